// What src/interface/bodies.h promises, a test each: a mesh becomes a blob, and what it says of
// itself is so.
#include "scene.h"

void promises_bodies(void);

// Memory that holds junk, another each time.
static void *take_junk(size_t size, void *user) {
  void *memory = malloc(size);
  if (memory) memset(memory, *(const int *)user, size);
  return memory;
}
static void give_junk(void *memory, void *user) {
  (void)user;
  free(memory);
}

// As a small body, for both methods, for the network alone, coarse, and of many patches.
static void a_mesh_is_always_the_same_bytes(void) {
  static const nsvcd_encode_options kinds[5] = {
      {.patches = 100}, {.latents = 1}, {.no_triangles = 1}, {.coarse = 1}, {.patches = 600}};
  nsvcd_mesh mug = mug_mesh();
  for (int i = 0; i < 5; i++) {
    const nsvcd_body *bodies[2] = {NULL, NULL};
    int junk[2] = {0, 0xa5};
    nsvcd_allocator allocators[2];
    for (int k = 0; k < 2; k++) {
      allocators[k] = (nsvcd_allocator){take_junk, give_junk, &junk[k]};
      CHECK_EQ(nsvcd_encode(&mug, &kinds[i], &allocators[k], NULL, 0, &bodies[k]), NSVCD_OK);
    }
    const size_t size = nsvcd_body_describe(bodies[0]).size;
    CHECK_EQ(nsvcd_body_describe(bodies[1]).size, size);
    CHECK(!memcmp(bodies[0], bodies[1], size));
    for (int k = 0; k < 2; k++) nsvcd_body_free(bodies[k], &allocators[k]);
  }
  nsvcd_mesh_free(&mug, NULL);
}

// It holds the same bytes as what an allocator gives, with triangles or without.
static void a_body_is_encoded_into_the_callers_memory(void) {
  static NSVCD_MEMORY(memory, 1 << 16);
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  for (int k = 0; k < 2; k++) {
    const nsvcd_encode_options options = {.patches = 16, .no_triangles = k};
    const nsvcd_body *body = NULL, *same = NULL;
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &same), NSVCD_OK);
    const nsvcd_body_facts facts = nsvcd_body_describe(same);
    CHECK(facts.patches <= 16 && facts.triangles == (k ? 0 : 12));
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory, facts.size - 1, &body),
             NSVCD_ERROR_WORKSPACE);
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, (char *)memory + 4, facts.size, &body),
             NSVCD_ERROR_WORKSPACE);
    CHECK(body == NULL);
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory, facts.size, &body), NSVCD_OK);
    CHECK((const void *)body == (const void *)memory);
    CHECK(!memcmp(body, same, facts.size));
    nsvcd_body_free(same, NULL);
  }
  CHECK(nsvcd_body_size(0) == 0 && nsvcd_body_size(NSVCD_MAX_PATCHES + 1) == 0);
  CHECK_LE(nsvcd_body_size(NSVCD_SMALL_PATCHES), 65535);
  nsvcd_mesh_free(&mesh, NULL);
}

static void a_body_survives_a_file(void) {
  const nsvcd_encode_options options = {.latents = 1};
  const nsvcd_body *mug = body_of(mug_mesh(), &options), *rack = body_of(mug_mesh(), &options);
  const nsvcd_pose poses[2] = {at(-0.3f, 0.02f, 0.01f), at(0.3f, 0.02f, 0.01f)};
  const size_t size = nsvcd_body_describe(mug).size;
  const nsvcd_body *loaded = NULL, *trusted = NULL;
  void *copy = malloc(size);
  FILE *file = tmpfile();
  CHECK(file && fwrite(mug, 1, size, file) == size);
  rewind(file);
  CHECK_EQ(fread(copy, 1, size, file), size);
  fclose(file);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_OK);
  CHECK_EQ(nsvcd_body_trust(copy, size, &trusted), NSVCD_OK);
  CHECK(loaded == copy && trusted == copy);
  for (int network = 0; network < 2; network++) {
    nsvcd_question question = question_about(mug, poses, 2, rack);
    question.method = network ? NSVCD_METHOD_NETWORK : NSVCD_METHOD_PROOF;
    const nsvcd_answer before = answer_to(&question);
    question.a.body = loaded;
    const nsvcd_answer after = answer_to(&question);
    CHECK(after.verdict == before.verdict && after.work == before.work);
    CHECK(!memcmp(&after.opinion.logit, &before.opinion.logit, sizeof before.opinion.logit));
  }
  loaded = trusted = NULL;
  CHECK_EQ(nsvcd_body_load(copy, size - 1, &loaded), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_trust(copy, size - 1, &trusted), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_trust((char *)copy + 4, size - 8, &trusted), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_trust((char *)copy + 8, size - 8, &trusted), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_trust(NULL, size, &trusted), NSVCD_ERROR_ARGUMENT);
  CHECK(!loaded && !trusted);
  free(copy);
  nsvcd_body_free(mug, NULL);
  nsvcd_body_free(rack, NULL);
}

// What a machine of the other byte order has written, word for word.
static void a_body_of_the_other_byte_order_is_refused(void) {
  const nsvcd_body *mug = box(0.1f, 0.1f, 0.12f), *loaded = NULL;
  const size_t size = nsvcd_body_describe(mug).size;
  unsigned char *copy = (unsigned char *)malloc(size);
  for (size_t i = 0; i < size; i++) copy[i / 4 * 4 + 3 - i % 4] = ((const unsigned char *)mug)[i];
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_VERSION);
  CHECK_EQ(nsvcd_body_trust(copy, size, &loaded), NSVCD_ERROR_VERSION);
  CHECK(strstr(nsvcd_result_string(NSVCD_ERROR_VERSION), "byte order") != NULL);
  CHECK(loaded == NULL);
  free(copy);
  nsvcd_body_free(mug, NULL);
}

// Whatever it becomes: of a body for a proof one bit, of a small one for the network all that it can.
static void a_body_with_any_byte_changed_is_refused(void) {
  static const nsvcd_encode_options small = {.patches = 2, .no_triangles = 1};
  for (int kind = 0; kind < 2; kind++) {
    const nsvcd_body *body = body_of(box_mesh(0.1f, 0.1f, 0.12f), kind ? &small : NULL);
    const nsvcd_body *loaded = NULL;
    const size_t size = nsvcd_body_describe(body).size;
    unsigned char *copy = (unsigned char *)malloc(size + 8);
    memcpy(copy, body, size);
    for (size_t i = 0; i < size; i++) {
      for (unsigned char other = 1; other; other = (unsigned char)(kind ? other + 1 : 2 * other)) {
        copy[i] ^= other;
        const nsvcd_result result = nsvcd_body_load(copy, size, &loaded);
        CHECK(result == NSVCD_ERROR_BODY || result == NSVCD_ERROR_VERSION);
        copy[i] ^= other;
      }
      CHECK_EQ(nsvcd_body_load(copy, i, &loaded), NSVCD_ERROR_BODY);  // cut short
    }
    CHECK_EQ(nsvcd_body_load(NULL, size, &loaded), NSVCD_ERROR_ARGUMENT);
    memmove(copy + 4, copy, size);
    CHECK_EQ(nsvcd_body_load(copy + 4, size, &loaded), NSVCD_ERROR_BODY);  // misaligned
    CHECK(loaded == NULL);
    free(copy);
    nsvcd_body_free(body, NULL);
  }
}

static void what_a_body_says_of_itself_is_so(void) {
  nsvcd_mesh mesh = mug_mesh();
  const nsvcd_body *body = body_of(mug_mesh(), NULL);
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  CHECK(facts.triangles == mesh.triangle_count && facts.components > 0);
  CHECK_EQ(facts.open_components, 0);
  CHECK(facts.quantization_error == 0 && !facts.latents && !facts.open);
  for (size_t i = 0; i < mesh.vertex_count; i++) {
    const float *p = mesh.positions + 3 * i;
    int covered = 0;
    for (uint32_t patch = 0; patch <= facts.patches; patch++) {
      const int is_last = patch == facts.patches;  // the sphere of the whole
      float c[3] = {facts.centre[0], facts.centre[1], facts.centre[2]}, radius = facts.radius;
      CHECK_EQ(nsvcd_body_patch(body, patch, c, &radius), !is_last);
      const double x = p[0] - c[0], y = p[1] - c[1], z = p[2] - c[2];
      const int is_in = sqrt(x * x + y * y + z * z) <= (double)radius + 1e-6;
      if (is_last) CHECK(is_in);
      covered += is_in && !is_last;
    }
    CHECK(covered > 0);
  }
  CHECK_EQ(nsvcd_body_describe(NULL).size, 0);
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_body_free(body, NULL);
}

static void patches_are_as_many_as_asked_for(void) {
  const nsvcd_encode_options few = {.patches = 20};
  const nsvcd_body *body = body_of(box_mesh(1, 1, 1), &few);
  CHECK_EQ(nsvcd_body_describe(body).patches, 20);
  nsvcd_body_free(body, NULL);
  size_t fewer = NSVCD_MAX_PATCHES;
  for (int k = 1; k < 4; k++) {  // larger ones are fewer
    const nsvcd_encode_options wide = {.patch_radius = 0.02f * (float)k};
    body = body_of(box_mesh(0.2f, 0.3f, 0.25f), &wide);
    const nsvcd_body_facts facts = nsvcd_body_describe(body);
    CHECK(facts.patches < fewer);
    CHECK_NEAR(facts.mean_patch_radius, wide.patch_radius, 0.4 * (double)wide.patch_radius);
    fewer = facts.patches;
    nsvcd_body_free(body, NULL);
  }
}

// Where nothing is said: 192 of a coarse mesh, and one for 50 triangles of a fine one, up to 512.
static void a_finer_mesh_has_more_patches(void) {
  static const size_t sides[4] = {50, 72, 90, 170}, wanted[4] = {192, 207, 324, 512};
  for (int k = 0; k < 4; k++) {
    const nsvcd_body *body = body_of(sheet_mesh(sides[k], 0), NULL);
    CHECK_EQ(nsvcd_body_describe(body).patches, wanted[k]);
    nsvcd_body_free(body, NULL);
  }
}

// Components, those of them that are open, and their edges.
static nsvcd_body_facts facts_of(const nsvcd_mesh *mesh) {
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode(mesh, NULL, NULL, NULL, 0, &body), NSVCD_OK);
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  nsvcd_body_free(body, NULL);
  return facts;
}
static void what_is_not_closed_is_told(void) {
  const nsvcd_encode_options said = {.open = 1};
  const nsvcd_body *open = body_of(box_mesh_of(1, 1, 1, OPEN_BOX_FACES), &said);
  nsvcd_mesh bin = box_mesh_of(1, 1, 1, OPEN_BOX_FACES), box = box_mesh(1, 1, 1);
  nsvcd_body_facts facts = facts_of(&bin);
  CHECK(facts.components == 1 && facts.open_components == 1 && facts.open_edges == 4);
  CHECK(!facts.open && nsvcd_body_describe(open).open);
  facts = facts_of(&box);
  CHECK(facts.components == 1 && facts.open_components == 0 && facts.open_edges == 0);

  // Vertices at one place are one, 0 and -0 are the same, and what has no area opens nothing.
  float positions[3 * 39];
  uint32_t indices[39];
  nsvcd_mesh split = {positions, indices, 39, 13};
  for (uint32_t i = 0; i < 39; i++) {
    indices[i] = i;
    for (uint32_t k = 0; k < 3; k++) {
      const float x = box.positions[3 * box.indices[i % 36] + k] + 0.5f;  // from 0 to 1
      positions[3 * i + k] = x > 0 ? x : i % 2 ? 0.0f : -0.0f;
    }
  }
  memcpy(positions + 3 * 38, positions + 3 * 37, 3 * sizeof *positions);
  facts = facts_of(&split);
  CHECK(facts.components == 1 && facts.open_components == 0 && facts.open_edges == 0);
  nsvcd_body_free(open, NULL);
  nsvcd_mesh_free(&bin, NULL);
  nsvcd_mesh_free(&box, NULL);
}

// Faces whose corners are a hair apart, as exports have them, enclose all the same: what is inside is
// a hit. Faces a centimetre apart do not.
static void corners_that_nearly_meet_are_joined(void) {
  static const float gaps[3] = {0, 1e-5f, 1e-2f};
  const nsvcd_body *ball = box(0.1f, 0.1f, 0.1f);
  for (int k = 0; k < 3; k++) {
    nsvcd_mesh lid = box_mesh(1, 1, 1), bin = box_mesh_of(1, 1, 1, OPEN_BOX_FACES);
    lid.triangle_count = 2;  // the last face
    memmove(lid.indices, lid.indices + 30, 6 * sizeof(uint32_t));
    const nsvcd_body *crate = body_of(stacked(bin, lid, gaps[k]), NULL);
    const nsvcd_pose pose = at(0.1f, 0.2f, 0);
    const nsvcd_question question = question_about(ball, &pose, 1, crate);
    CHECK_EQ(nsvcd_body_describe(crate).open_components > 0, k == 2);
    CHECK_EQ(verdict_of(&question) == NSVCD_HIT, k < 2);
    nsvcd_body_free(crate, NULL);
  }
  nsvcd_body_free(ball, NULL);
}

// By a factor for each axis, mirrored too: the bounds are those of the stretched box; latents stay
// behind, and what has nothing else, or is round, is refused.
static void a_body_is_stretched(void) {
  const float factors[3] = {-2, 0.5f, 3};
  nsvcd_mesh mesh = box_mesh(0.1f, 0.2f, 0.3f);
  nsvcd_encode_options options = {0};
  const nsvcd_body *both, *network, *round, *scaled = NULL;
  const float half[3] = {1, 1, 1};
  options.latents = 1;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &both), NSVCD_OK);
  options.no_triangles = 1;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &network), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_box(half, 0.1f, NULL, &round), NSVCD_OK);
  const size_t size = 1 << 18;
  void *memory = malloc(size);
  const nsvcd_body_facts before = nsvcd_body_describe(both);
  CHECK_EQ(nsvcd_body_scale(both, factors, memory, size, &scaled), NSVCD_OK);
  const nsvcd_body_facts after = nsvcd_body_describe(scaled);
  for (int k = 0; k < 3; k++) {
    const float low = factors[k] * (factors[k] < 0 ? before.high[k] : before.low[k]);
    CHECK_NEAR(after.low[k], low, 1e-5);
  }
  CHECK(after.size < before.size && !after.latents);
  CHECK_EQ(after.open_components, 0);
  CHECK_EQ(nsvcd_body_load(memory, after.size, &scaled), NSVCD_OK);
  CHECK_EQ(nsvcd_body_scale(network, factors, memory, size, &scaled), NSVCD_ERROR_TRIANGLES);
  CHECK_EQ(nsvcd_body_scale(round, factors, memory, size, &scaled), NSVCD_ERROR_SCALE);
  free(memory);
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_body_free(both, NULL);
  nsvcd_body_free(network, NULL);
  nsvcd_body_free(round, NULL);
}

static void a_scaled_body_is_that_of_the_scaled_mesh(void) {
  const nsvcd_body *small = box(0.1f, 0.2f, 0.3f);
  const nsvcd_body *large = box(0.2f, 0.4f, 0.6f);
  const size_t size = nsvcd_body_describe(small).size;
  void *memory = malloc(size + 8);
  const nsvcd_body *scaled = NULL;
  CHECK_EQ(nsvcd_body_scale(small, (const float[3]){2, 2, 2}, memory, size, &scaled), NSVCD_OK);
  CHECK_NEAR(nsvcd_body_describe(scaled).radius, nsvcd_body_describe(large).radius, 1e-5);
  // Each stops 1 mm before a post.
  const nsvcd_body *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[2] = {at(-1, 0, 0), at(-0.151f, 0, 0)};
  nsvcd_question question = question_about(scaled, poses, 2, post);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.clearance = 0.0011f;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  const float bad[4] = {0, NAN, HUGE_VALF, 1e30f};
  for (int k = 0; k < 4; k++)
    CHECK_EQ(
        nsvcd_body_scale(small, (const float[3]){bad[k], bad[k], bad[k]}, memory, size, &scaled),
        NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(small, (const float[3]){2, 2, 2}, memory, size - 1, &scaled),
           NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_body_scale(small, (const float[3]){2, 2, 2}, (char *)memory + 4, size, &scaled),
           NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_body_scale(small, (const float[3]){2, 2, 2}, NULL, size, &scaled),
           NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_body_scale(NULL, (const float[3]){2, 2, 2}, memory, size, &scaled),
           NSVCD_ERROR_ARGUMENT);
  CHECK((const void *)scaled == memory);
  free(memory);
  nsvcd_body_free(post, NULL);
  nsvcd_body_free(large, NULL);
  nsvcd_body_free(small, NULL);
}

// Spheres, capsules, boxes with round edges, and clouds of points are exact: 1 m from a sphere.
static void round_shapes_are_as_far_apart_as_geometry_says(void) {
  const float from[3] = {0, 0, -1}, to[3] = {0, 0, 1}, half[3] = {0.2f, 0.2f, 0.2f};
  const float points[6] = {0, 0, 0, 0, 5, 0};
  const nsvcd_body *shapes[4] = {NULL, NULL, NULL, NULL};
  CHECK_EQ(nsvcd_encode_sphere(0.2f, NULL, &shapes[0]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_capsule(from, to, 0.2f, NULL, &shapes[1]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_box(half, 0.05f, NULL, &shapes[2]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_cloud(points, 2, 0.2f, NULL, &shapes[3]), NSVCD_OK);
  const nsvcd_pose pose = at(1.5f, 0, 0);
  const nsvcd_body *ball = NULL;
  CHECK_EQ(nsvcd_encode_sphere(0.3f, NULL, &ball), NSVCD_OK);
  for (int i = 0; i < 4; i++) {
    nsvcd_question question = question_about(ball, &pose, 1, shapes[i]);
    question.ask = NSVCD_ASK_DISTANCE;
    question.to = 1e-3f;
    const nsvcd_range distance = answer_to(&question).distance;
    CHECK(distance.low <= 1 + 1e-6f && distance.high >= 1 - 1e-6f);
    CHECK_LE(distance.high - distance.low, 1e-3 + 3e-6);  // and float's roundings
    nsvcd_body_free(shapes[i], NULL);
  }
  nsvcd_body_free(ball, NULL);
  CHECK_EQ(nsvcd_encode_sphere(0, NULL, &ball), NSVCD_ERROR_RADIUS);
}

// What is done never becomes less; whenever the caller stops it, all memory is given back.
typedef struct followed {
  float done;
  int calls, stop_at, given;
} followed;
static int follow(float done, void *user) {
  followed *f = (followed *)user;
  CHECK(done >= f->done && done <= 1);
  f->done = done;
  return ++f->calls == f->stop_at;
}
static void *take_counted(size_t size, void *user) {
  ((followed *)user)->given++;
  return malloc(size);
}
static void give_counted(void *memory, void *user) {
  ((followed *)user)->given--;
  free(memory);
}
static void encoding_tells_how_much_is_done_and_can_be_cancelled(void) {
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  for (int patches = 20; patches < 700; patches += 600) {  // of one region, and of several
    const nsvcd_body *body = NULL;
    for (int stop_at = 1; !body; stop_at++) {
      followed f = {0, 0, stop_at, 0};
      const nsvcd_allocator allocator = {take_counted, give_counted, &f};
      const nsvcd_encode_options options = {
          .patches = (size_t)patches, .latents = 1, .progress = follow, .user = &f};
      const nsvcd_result result = nsvcd_encode(&mesh, &options, &allocator, NULL, 0, &body);
      CHECK_EQ(result, body ? NSVCD_OK : NSVCD_ERROR_CANCELLED);
      if (body) CHECK(f.calls >= (patches > 512 ? 3 : 1) && f.calls == stop_at - 1 && f.given == 1);
      nsvcd_body_free(body, &allocator);
      CHECK_EQ(f.given, 0);
    }
  }
  nsvcd_mesh_free(&mesh, NULL);
}

static void bodies_are_as_small_and_as_large_as_is_said(void) {
  const float least = 2.4f * NSVCD_MIN_RADIUS, most = 1.9f * NSVCD_MAX_COORDINATE;
  const float sizes[4] = {least, most, 0.1f * NSVCD_MIN_RADIUS, 2.1f * NSVCD_MAX_COORDINATE};
  const nsvcd_result results[4] = {NSVCD_OK, NSVCD_OK, NSVCD_ERROR_EMPTY, NSVCD_ERROR_NUMBER};
  for (int i = 0; i < 8; i++) {
    const nsvcd_encode_options options = {.latents = i / 4};
    nsvcd_mesh mesh = box_mesh(1, 1, 1);
    const nsvcd_body *body = NULL;
    for (size_t k = 0; k < 3 * mesh.vertex_count; k++) mesh.positions[k] *= sizes[i % 4];
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), results[i % 4]);
    nsvcd_body_free(body, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

// With or without latents, and what was to point to it points where it did.
static void a_mesh_that_cannot_be_is_refused(void) {
  static const float bad[5] = {NAN, HUGE_VALF, -HUGE_VALF, 1.01e6f, -2e6f};
  const nsvcd_body *body = NULL;
  nsvcd_mesh good = box_mesh(1, 1, 1);
#define REFUSED(code, change)                                            \
  do {                                                                   \
    nsvcd_mesh mesh = good;                                              \
    nsvcd_encode_options options = {.latents = 1};                       \
    change;                                                              \
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), code); \
    options.latents = 0;                                                 \
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), code); \
    CHECK(body == NULL);                                                 \
  } while (0)
  REFUSED(NSVCD_ERROR_PATCHES, options.patches = NSVCD_MAX_PATCHES + 1);
  REFUSED(NSVCD_ERROR_PATCHES, options.patch_radius = -1);
  REFUSED(NSVCD_ERROR_PATCHES, options.patch_radius = NAN);
  REFUSED(NSVCD_ERROR_EMPTY, mesh.triangle_count = 0);
  REFUSED(NSVCD_ERROR_ARGUMENT, mesh.positions = NULL);
  REFUSED(NSVCD_ERROR_INDEX, mesh.vertex_count = BOX_CORNERS - 1);
  REFUSED(NSVCD_ERROR_TOO_LARGE, mesh.vertex_count = 0x80000000u);
  REFUSED(NSVCD_ERROR_TOO_LARGE, mesh.triangle_count = 0x80000000u);
  for (int k = 0; k < 5; k++) {
    good.positions[3 * BOX_CORNERS - 1] = bad[k];
    REFUSED(NSVCD_ERROR_NUMBER, (void)0);
  }
  for (size_t i = 0; i < 3 * BOX_CORNERS; i++) good.positions[i] = 1;  // no area
  REFUSED(NSVCD_ERROR_EMPTY, (void)0);
#undef REFUSED
  CHECK_EQ(nsvcd_encode(NULL, NULL, NULL, NULL, 0, &body), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_encode(&good, NULL, NULL, NULL, 0, NULL), NSVCD_ERROR_ARGUMENT);
  nsvcd_mesh_free(&good, NULL);
  nsvcd_mesh_free(&good, NULL);  // twice does no harm
  nsvcd_mesh_free(NULL, NULL);
}

void promises_bodies(void) {
  RUN(a_mesh_is_always_the_same_bytes);
  RUN(a_body_is_encoded_into_the_callers_memory);
  RUN(a_body_survives_a_file);
  RUN(a_body_of_the_other_byte_order_is_refused);
  RUN(a_body_with_any_byte_changed_is_refused);
  RUN(what_a_body_says_of_itself_is_so);
  RUN(patches_are_as_many_as_asked_for);
  RUN(a_finer_mesh_has_more_patches);
  RUN(what_is_not_closed_is_told);
  RUN(corners_that_nearly_meet_are_joined);
  RUN(a_scaled_body_is_that_of_the_scaled_mesh);
  RUN(a_body_is_stretched);
  RUN(round_shapes_are_as_far_apart_as_geometry_says);
  RUN(encoding_tells_how_much_is_done_and_can_be_cancelled);
  RUN(bodies_are_as_small_and_as_large_as_is_said);
  RUN(a_mesh_that_cannot_be_is_refused);
}

CHECK_ALONE(promises_bodies)
