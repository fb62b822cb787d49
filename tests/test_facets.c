// Bodies as their users handle them: saved, loaded, described, scaled; and forged blobs of the proof,
// which are refused, or harmless.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"
#include "../src/body/scale.h"
#include "../src/body/encode.h"
#include "../src/query/question.h"

#include "query_scene.h"
#include "proof_scene.h"

void test_facets(void);

// A scaled body against the body of a scaled mesh. By a power of two the patches agree to the bit,
// and so do bodies; by other factors sampling may round differently, and a latent is quantised to
// 1/127.
static void query_scaled_bodies_are_bodies_of_scaled_meshes(void) {
  int close = 0;
  int compared = 0;
  for (uint64_t seed = 1; seed <= 12; seed++) {
    float scale = seed % 2 ? 0.5f : 1.3f;
    query_scene s;
    query_scene_open(&s, seed);
    nsvcd_mesh mesh = query_solid(2 * seed, 0.2);
    for (size_t i = 0; i < 3 * mesh.vertex_count; i++) mesh.positions[i] *= scale;
    query_memory encoded_memory;
    query_memory scaled_memory = query_reserve(nsvcd_body_describe(s.moving).size);
    const nsvcd_body *encoded = query_encode(&mesh, QUERY_POINTS, &encoded_memory);
    const nsvcd_body *scaled = NULL;
    CHECK_EQ(nsvcd_body_scale(s.moving, (const float[3]){scale, scale, scale}, scaled_memory.at,
                              nsvcd_body_describe(s.moving).size, &scaled),
             NSVCD_OK);
    if (encoded && scaled) {
      nsvcd_answer a = query_ask(encoded, s.motion, QUERY_POSES, s.fixed, &s.fixed_pose, NULL);
      nsvcd_answer b = query_ask(scaled, s.motion, QUERY_POSES, s.fixed, &s.fixed_pose, NULL);
      int near =
          fabs((double)(logit_of(&a) - logit_of(&b))) <= 0.05 * (1 + fabs((double)logit_of(&a)));
      CHECK_EQ(status_of(&a), status_of(&b));
      if (seed % 2) CHECK(near);
      close += near;
      compared++;
      CHECK_NEAR(nsvcd_body_describe(encoded).radius / nsvcd_body_describe(scaled).radius, 1, 1e-3);
    }
    query_release(&encoded_memory);
    query_release(&scaled_memory);
    nsvcd_mesh_free(&mesh, NULL);
    query_scene_close(&s);
  }
  CHECK_GE(close, compared - 1);  // one may tip over in the choice of patches
}

// What is not within a scaled bound of the body and the rounding of a vertex is not within the
// body's: bounds of patch i are multiplied outward.
static int facets_are_outward(const nsvcd_body *body, const nsvcd_body *scaled, double scale,
                              size_t i) {
  const nsvcd__geometry a = nsvcd__geometry_of(nsvcd__triangles_of(body));
  const nsvcd__geometry b = nsvcd__geometry_of(nsvcd__triangles_of(scaled));
  const nsvcd__slab from = nsvcd__slab_at(a.slabs, body->padded, i);
  const nsvcd__slab to = nsvcd__slab_at(b.slabs, body->padded, i);
  // half a unit in the last place of a scaled vertex, as far as one can be
  const double far =
      (double)nsvcd__f3_norm(nsvcd__patch_centre(&b, i)) + 32768.0 * (double)b.steps[i];
  const double least = 6e-8 * far;
  return (double)to.low <= scale * (double)from.low - least &&
         (double)to.high >= scale * (double)from.high + least &&
         (double)to.across >= scale * (double)from.across + least &&
         (double)b.margins[i] >= scale * (double)a.margins[i] + least &&
         (double)b.errors[i] >= scale * (double)a.errors[i] + least;
}

// One patch may reach farther than its middle: what is scaled so far can be loaded.
static void facets_scaled_far_are_loaded(void) {
  float positions[12] = {-0.3f, 0, -250000, 0.4f, 0.3f, 0, 0.4f, -0.4f, 0, 0.5f, -0.4f, 0.4f};
  uint32_t indices[12] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  const nsvcd_mesh mesh = {positions, indices, 4, 4};
  nsvcd_encode_options options = {.patches = 1};
  const nsvcd_body *body = NULL;
  const nsvcd_body *scaled = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_OK);
  const size_t size = nsvcd_body_describe(body).size;
  query_memory memory = query_reserve(size);
  CHECK_EQ(nsvcd_body_scale(body, (const float[3]){7, 7, 7}, memory.at, size, &scaled), NSVCD_OK);
  CHECK_EQ(nsvcd_body_load(scaled, size, &scaled), NSVCD_OK);
  CHECK_EQ(nsvcd_body_scale(body, (const float[3]){1000, 1000, 1000}, memory.at, size, &scaled),
           NSVCD_ERROR_SCALE);
  query_release(&memory);
  nsvcd_body_free(body, NULL);
}

// ------------------------------------------------------------------------------------ forged blobs

typedef struct forgery {
  size_t size;
  void *memory;
  struct nsvcd_body *body, *inner;  // of triangles
} forgery;

static forgery proof_forge(const nsvcd_body *body) {
  forgery f;
  f.size = body->size;
  f.memory = malloc(f.size);
  if (!f.memory) exit(1);
  memcpy(f.memory, body, f.size);
  f.body = (struct nsvcd_body *)f.memory;
  f.inner =
      f.body->weights_id ? (struct nsvcd_body *)(void *)((char *)f.memory + f.body->inner) : f.body;
  return f;
}

// Loads what has been forged, its checksums put right.
static nsvcd_result proof_load(forgery *f) {
  const nsvcd_body *body = NULL;
  if (f->inner->size <= f->size - (size_t)((char *)f->inner - (char *)f->memory))
    f->inner->checksum = nsvcd__body_checksum(f->inner);
  if (f->body->size <= f->size) f->body->checksum = nsvcd__body_checksum(f->body);
  return nsvcd_body_load(f->memory, f->size, &body);
}

static void proof_expect_refusal(const nsvcd_body *body, size_t offset, const void *value,
                                 size_t bytes) {
  forgery f = proof_forge(body);
  memcpy((char *)f.inner + offset, value, bytes);
  const nsvcd_result result = proof_load(&f);
  CHECK(result == NSVCD_ERROR_BODY || result == NSVCD_ERROR_VERSION);
  free(f.memory);
}

static size_t proof_offset(const nsvcd__geometry *f, const void *at) {
  return (size_t)((const char *)at - (const char *)f->body);
}

static void proof_forge_floats(const nsvcd_body *body, const nsvcd__geometry *f) {
  const float bad[3] = {NAN, INFINITY, -1e30f};
  const size_t padded = f->body->padded;
  const float *arrays[5] = {f->slabs, f->steps, f->margins, f->errors, f->seeds};
  const size_t counts[5] = {6 * padded, padded, padded, padded, 3 * f->counts->components};
  for (int k = 0; k < 5; k++) {
    for (size_t n = 0; n < counts[k]; n += 1 + counts[k] / 40) {
      for (int b = 0; b < 3; b++)
        proof_expect_refusal(body, proof_offset(f, arrays[k] + n), &bad[b], 4);
    }
  }
  const float negative = -1e-6f;
  for (int k = 1; k < 4; k++) proof_expect_refusal(body, proof_offset(f, arrays[k]), &negative, 4);
  proof_expect_refusal(body, proof_offset(f, f->slabs + 5 * padded), &negative, 4);
}

static void proof_forge_counts(const nsvcd_body *body, const nsvcd__geometry *f) {
  const size_t counts = nsvcd__spheres_size(f->body->padded);
  // what is told of components is not known to be wrong
  for (size_t k = 0; k < offsetof(nsvcd__counts, solids) / 4; k++) {
    uint32_t value;
    // how round it is has tests of its own, in test_round.c
    if (4 * k == offsetof(nsvcd__counts, convex_radius)) continue;
    memcpy(&value, (const char *)f->body + counts + 4 * k, 4);
    const uint32_t bad[6] = {value + 1,   value - 1,   0xffffffffu,
                             0x80000000u, 0x55555556u, value ^ 0x10000u};
    for (int n = 0; n < 6; n++) proof_expect_refusal(body, counts + 4 * k, &bad[n], 4);
  }
  for (size_t i = 0; i <= f->body->patches; i++) {
    const uint32_t *firsts[3] = {f->first_vertex + i, f->first_triangle + i, f->first_byte + i};
    const uint32_t bad[3] = {0xffffffffu, 0x7fffffffu, i == 0 ? 1u : *firsts[0] - 70000u};
    for (int k = 0; k < 3; k++) {
      for (int n = 0; n < 3; n++)
        proof_expect_refusal(body, proof_offset(f, firsts[k]), &bad[n], 4);
    }
  }
  for (size_t i = 0; i < f->body->patches; i++) {
    const uint8_t bad[2] = {NSVCD__HULL + 1, f->hull_counts[i] ? 0 : 1};
    for (int n = 0; n < 2; n++)
      proof_expect_refusal(body, proof_offset(f, f->hull_counts + i), &bad[n], 1);
  }
  const unsigned char far[5] = {0xff, 0xff, 0xff, 0xff, 0x0f};
  const unsigned char endless[5] = {0x80, 0x80, 0x80, 0x80, 0x80};
  for (size_t i = 0; i < f->body->patches; i++) {
    const unsigned char *at = proof_numbers(f, i);
    const unsigned char *end = f->entries + f->first_byte[i + 1];
    if (end - at >= 5) proof_expect_refusal(body, proof_offset(f, at), far, 5);
    if (end - at >= 5) proof_expect_refusal(body, proof_offset(f, at), endless, 5);
    if (end > at) proof_expect_refusal(body, proof_offset(f, end - 1), endless, 1);
  }
}

static void proof_forge_header(const nsvcd_body *body, const nsvcd__geometry *f) {
  const uint32_t bad[4] = {0, 1, 0x7fffffffu, 0xfffffff8u};
  const size_t fields[6] = {
      offsetof(struct nsvcd_body, size),    offsetof(struct nsvcd_body, weights_id),
      offsetof(struct nsvcd_body, patches), offsetof(struct nsvcd_body, padded),
      offsetof(struct nsvcd_body, inner),   offsetof(struct nsvcd_body, triangles)};
  for (int k = 0; k < 6; k++) {
    for (int n = 0; n < 4; n++) {
      uint32_t value;
      memcpy(&value, (const char *)f->body + fields[k], 4);
      if (value == bad[n]) continue;
      if (k == 5 && f->body == body && bad[n] > value)
        continue;  // a count of triangles too large is harmless
      proof_expect_refusal(body, fields[k], &bad[n], 4);
    }
  }
}

// A blob whose last words are any: either it is refused, or questions about it end, and read
// nothing that is not there.
static void proof_forge_anything(const nsvcd_body *body, shapes_rng *rng, size_t *accepted) {
  forgery f = proof_forge(body);
  nsvcd_question options = proof_options();
  const size_t from = (size_t)((char *)f.inner - (char *)f.memory) + sizeof(struct nsvcd_body);
  const int changes = 1 + shapes_pick(rng, 4);
  for (int k = 0; k < changes; k++) {
    const size_t at = from + shapes_next(rng) % (f.size - from);
    ((unsigned char *)f.memory)[at] = (unsigned char)(shapes_next(rng) >> 40);
  }
  options.work = 3000;
  if (!proof_load(&f)) {
    const proof_body *other = proof_shared(0, (size_t)shapes_pick(rng, MAKES));
    nsvcd_pose poses[3];
    nsvcd_answer answer;
    for (int n = 0; n < 3; n++) {
      double q[4];
      shapes_quaternion(rng, q);
      for (int k = 0; k < 4; k++) poses[n].rotation[k] = (float)q[k];
      for (int k = 0; k < 3; k++) poses[n].position[k] = (float)shapes_uniform(rng, -0.2, 0.2);
    }
    (*accepted)++;
    for (int side = 0; side < 2; side++) {
      const nsvcd_question question = question_of(side ? other->body : f.body, poses, 3,
                                                  side ? f.body : other->body, NULL, &options);
      CHECK_EQ(nsvcd_sweep(&question, proof_workspace(), nsvcd_sweep_workspace_size(NULL), &answer),
               NSVCD_OK);
    }
  }
  free(f.memory);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

static void facets_are_scaled_outward(void) {
  static const float scales[4] = {0.001f, 0.3f, 1.7f, 1000};
  size_t inward = 0;
  nsvcd_mesh mesh = query_solid(4, 0.2);
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), NSVCD_OK);
  nsvcd_mesh_free(&mesh, NULL);
  const size_t size = nsvcd_body_describe(body).size;
  query_memory memory = query_reserve(size);
  for (size_t k = 0; k < 4; k++) {
    const nsvcd_body *scaled = NULL;
    CHECK_EQ(nsvcd_body_scale(body, (const float[3]){scales[k], scales[k], scales[k]}, memory.at,
                              size, &scaled),
             NSVCD_OK);
    for (size_t i = 0; i < body->patches; i++)
      inward += !facets_are_outward(body, scaled, (double)scales[k], i);
  }
  CHECK_EQ(inward, 0);
  query_release(&memory);
  nsvcd_body_free(body, NULL);
}

static void proof_forged_blobs(void) {
  static const size_t makes[4] = {1, 5, 6, 11};
  shapes_rng rng = {64};
  size_t accepted = 0;
  for (int k = 0; k < 4; k++) {
    const nsvcd_body *body = proof_shared(0, makes[k])->body;
    forgery f = proof_forge(body);
    CHECK_EQ(proof_load(&f), NSVCD_OK);
    const nsvcd__geometry facets = nsvcd__geometry_of(nsvcd__triangles_of(body));
    proof_forge_floats(body, &facets);
    proof_forge_counts(body, &facets);
    proof_forge_header(body, &facets);
    for (int n = 0; n < 400; n++) proof_forge_anything(body, &rng, &accepted);
    // The body of triangles by itself is a body as well.
    proof_forge_floats(facets.body, &facets);
    proof_forge_counts(facets.body, &facets);
    for (int n = 0; n < 400; n++) proof_forge_anything(facets.body, &rng, &accepted);
    free(f.memory);
  }
  printf("  of 3200 blobs with random bytes %zu were accepted, and asked\n", accepted);
}

void test_facets(void) {
  RUN(query_scaled_bodies_are_bodies_of_scaled_meshes);
  RUN(facets_scaled_far_are_loaded);
  // from within
  RUN(facets_are_scaled_outward);
  RUN(proof_forged_blobs);
}

CHECK_ALONE(test_facets)
