// Small meshes, bad ones among them: refused with a code, or encoded, and then asked about. What is
// proven is looked at in double: surfaces that are certified free do not cross at 33 times, and the
// triangles of a witness are as near as it says.
#define FUZZ_TARGET "mesh"
#define FUZZ_TOKENS
#include "main.h"

#include "../../examples/scenery/oracle.h"
#include "../failing_heap.h"
#include "scene.h"

enum { VERTICES = 16, TRIANGLES = 20, TIMES = 33 };

typedef struct solid {
  scene_mesh made;
  const nsvcd_body *body;
} solid;

// ------------------------------------------------------------------------------------------- meshes

// Triangles of few places, so that vertices coincide and triangles are flat, or of any; or a box,
// with a vertex that may be elsewhere.
static void read_mesh(fuzz_input *in, scene_mesh *out) {
  const uint8_t kind = fuzz_byte(in);
  const size_t vertices = 3 + fuzz_choice(in, VERTICES - 2);
  const size_t triangles = fuzz_choice(in, TRIANGLES + 1);
  const float size = kind < 240 ? 0.25f : fuzz_float(in);
  if (kind % 3 == 0) {
    const float x = fuzz_float(in);
    const float y = fuzz_float(in);
    scene_box(out, size * x, size * y, size * fuzz_float(in));
    if (kind % 2)
      out->positions[fuzz_choice(in, 24)] = size * fuzz_float(in);
    return;
  }
  for (size_t k = 0; k < 3 * vertices; k++) {
    const float cell = (float)fuzz_choice(in, 4) / 2;
    out->positions[k] = size * (kind % 3 == 1 ? cell : fuzz_float(in));
  }
  for (size_t k = 0; k < 3 * triangles; k++) {
    const uint8_t index = fuzz_byte(in);
    out->indices[k] = index < 255 ? index % (uint32_t)vertices : fuzz_byte(in);
  }
  out->mesh.positions = out->positions;
  out->mesh.indices = out->indices;
  out->mesh.vertex_count = vertices;
  out->mesh.triangle_count = triangles;
}

static void read_options(fuzz_input *in, nsvcd_encode_options *options) {
  static const size_t odd[4] = {0, 40, NSVCD_MAX_PATCHES + 1, (size_t)-1};
  const uint8_t kind = fuzz_byte(in);
  memset(options, 0, sizeof *options);
  options->patches = kind < 248 ? 1 + (size_t)kind % 12 : odd[kind % 4];
  const uint8_t flags = fuzz_byte(in);
  options->open = flags % 8 == 1;
  options->no_triangles = flags / 8 % 8 == 1;
  options->latents = flags / 64 == 1;
  if (flags % 16 == 2)
    options->patch_radius = fuzz_float(in);
  if (!(options->patch_radius < 0.1f) && kind % 16 == 3)  // smaller ones only make many
    options->patches = 0;
}

static int encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options, int fail_at,
                  const nsvcd_body **body, nsvcd_result *result) {
  failing_heap heap = {0, 0, 0};
  nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
  const nsvcd_body *made = NULL;
  heap.fail_at = fail_at;
  allocator.user = &heap;
  *result = nsvcd_encode(mesh, options, &allocator, NULL, 0, &made);
  FUZZ_CHECK(heap.live == (*result ? 0 : 1));
  FUZZ_CHECK(!*result == (made != NULL));
  *body = made;
  return heap.calls;
}

// What nsvcd_encode has made can be loaded, also when it is scaled, and is the same again.
static void check_body(fuzz_input *in, const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                       const nsvcd_body *body) {
  static const float scales[4] = {0.3f, 1e3f, 1e-5f, 7};
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  const nsvcd_body *again = NULL;
  nsvcd_result result;
  FUZZ_CHECK(facts.patches >= 1 && scene_finite(&facts.radius, 1) && facts.radius > 0);
  FUZZ_CHECK(facts.triangles == (options->no_triangles ? 0 : mesh->triangle_count));
  FUZZ_CHECK(!nsvcd_body_load(body, facts.size, &again));
  encode(mesh, options, -1, &again, &result);
  FUZZ_CHECK(!result && memcmp(again, body, facts.size) == 0);
  // as a whole, or along each axis by another factor, mirrored too
  float by[3];
  by[0] = by[1] = by[2] = scales[fuzz_choice(in, 4)];
  if (fuzz_choice(in, 2)) {
    by[1] = scales[fuzz_choice(in, 4)];
    by[2] = -scales[fuzz_choice(in, 4)];
  }
  if (!nsvcd_body_scale(body, by, (void *)again, facts.size, &again))
    FUZZ_CHECK(!nsvcd_body_load(again, facts.size, &again));
  nsvcd_body_free(again, NULL);
}

// 1 if there is a body.
static int read_solid(fuzz_input *in, solid *out) {
  nsvcd_encode_options options;
  nsvcd_result result;
  const nsvcd_body *none = NULL;
  read_mesh(in, &out->made);
  read_options(in, &options);
  const uint8_t fails = fuzz_byte(in);
  const int calls = encode(&out->made.mesh, &options, -1, &out->body, &result);
  if (result)
    return 0;
  if (fails % 8 == 0) {
    encode(&out->made.mesh, &options, fails / 8 % calls, &none, &result);
    FUZZ_CHECK(result == NSVCD_ERROR_MEMORY);
  }
  if (fails % 8 == 1)
    check_body(in, &out->made.mesh, &options, out->body);
  return 1;
}

// -------------------------------------------------------------------------------------------- truth

// A mover in double. 0 where it makes half a turn between two poses: either way is the shorter.
typedef struct track {
  oracle_pose poses[SCENE_POSES];
  const float *times;
  size_t count;
  double scale;
} track;

static oracle_pose pose_at(const track *track, double t) {
  const float *times = track->times;
  size_t k = 0;
  if (!times || track->count < 2)
    return oracle_pose_at(track->poses, track->count, t);
  while (k + 2 < track->count && (double)times[k + 1] <= t)
    k++;
  const double from = (double)times[k];
  return oracle_pose_at(track->poses + k, 2, (t - from) / ((double)times[k + 1] - from));
}

static int track_of(const nsvcd_mover *mover, track *out) {
  const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  out->count = mover->count ? mover->count : 1;
  out->times = mover->times;
  out->scale = mover->scale > 0 ? (double)mover->scale : 1;
  for (size_t i = 0; i < out->count; i++) {
    const nsvcd_pose *pose = mover->count ? &mover->poses[i] : &origin;
    double *q = out->poses[i].rotation;
    double with_last = 0;
    for (int k = 0; k < 3; k++)
      out->poses[i].position[k] = (double)pose->position[k];
    for (int k = 0; k < 4; k++)
      q[k] = (double)pose->rotation[k];
    oracle_quat_normalize(q);
    for (int k = 0; k < 4 && i > 0; k++)
      with_last += q[k] * out->poses[i - 1].rotation[k];
    if (i > 0 && fabs(with_last) < 1e-3)
      return 0;
  }
  return 1;
}

// A triangle of the mesh as it stands at t. 0 if it is so thin that rounding decides about it.
static int triangle_at(const nsvcd_mesh *mesh, size_t n, const track *track, double t,
                       oracle_triangle *out) {
  const oracle_pose pose = pose_at(track, t);
  double edges[3][3];
  double longest = 0;
  for (size_t c = 0; c < 3; c++) {
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[3 * n + c];
    const double x[3] = {track->scale * (double)p[0], track->scale * (double)p[1],
                         track->scale * (double)p[2]};
    oracle_transform(&pose, x, out->v[c]);
  }
  for (size_t c = 0; c < 3; c++) {
    oracle_sub(out->v[(c + 1) % 3], out->v[c], edges[c]);
    longest = fmax(longest, oracle_dot(edges[c], edges[c]));
  }
  oracle_cross(edges[0], edges[1], out->normal);
  const double area = oracle_length(out->normal);
  for (int k = 0; k < 3 && area > 0; k++)
    out->normal[k] /= area;
  return area > 1e-3 * longest;
}

static double triangles_apart(const oracle_triangle *p, const oracle_triangle *q) {
  double on_p[3], on_q[3];
  return sqrt(oracle_triangles(p, q, 1e300, on_p, on_q));
}

static void check_free(const solid *a, const track *at_a, const solid *b, const track *at_b,
                       double clearance) {
  const nsvcd_mesh *mesh_a = &a->made.mesh;
  const nsvcd_mesh *mesh_b = &b->made.mesh;
  oracle_triangle p, q[TRIANGLES];
  int is_fat[TRIANGLES];
  for (int k = 0; k < TIMES; k++) {
    const double t = (double)k / (TIMES - 1);
    for (size_t j = 0; j < mesh_b->triangle_count; j++)
      is_fat[j] = triangle_at(mesh_b, j, at_b, t, &q[j]);
    for (size_t i = 0; i < mesh_a->triangle_count; i++) {
      if (!triangle_at(mesh_a, i, at_a, t, &p))
        continue;
      for (size_t j = 0; j < mesh_b->triangle_count; j++)
        FUZZ_CHECK(!is_fat[j] || triangles_apart(&p, &q[j]) > clearance * (1 - 1e-6));
    }
  }
}

// Metres that float knows of where the bodies are.
static double rounding_at(const solid *s, const track *at) {
  double most = at->scale * (double)nsvcd_body_describe(s->body).radius;
  for (int k = 0; k < 3; k++)
    most += at->scale * fabs((double)nsvcd_body_describe(s->body).centre[k]);
  for (size_t i = 0; i < at->count; i++)
    most += oracle_length(at->poses[i].position);
  return 1e-5 * most;
}

static void check_truth(const nsvcd_question *question, const solid *a, const solid *b,
                        const nsvcd_answer *answer) {
  track at_a, at_b;
  oracle_triangle p, q;
  if (!track_of(&question->a, &at_a) || !track_of(&question->b, &at_b))
    return;
  if (question->slop > 0)
    return;
  if (status_of(answer) == STATUS_CERTIFIED_FREE)
    check_free(a, &at_a, b, &at_b, (double)question->clearance);
  if (status_of(answer) != STATUS_WITNESS)
    return;
  const double t = (double)answer->nearest.time;
  const int fat = triangle_at(&a->made.mesh, answer->nearest.triangle_a, &at_a, t, &p) &
                  triangle_at(&b->made.mesh, answer->nearest.triangle_b, &at_b, t, &q);
  const double most =
      (double)answer->distance.high + rounding_at(a, &at_a) + rounding_at(b, &at_b);
  FUZZ_CHECK(!fat || triangles_apart(&p, &q) <= most);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static solid solids[2];
  fuzz_input in = {data, size};
  scene_question asked;
  nsvcd_answer answer;
  if (!read_solid(&in, &solids[0]))
    return 0;
  if (read_solid(&in, &solids[1])) {
    scene_ask_about(&in, solids[0].body, solids[1].body, &asked);
    if (scene_ask(&asked.question, &answer)) {
      fuzz_taken++;
      check_truth(&asked.question, &solids[0], &solids[1], &answer);
    }
    nsvcd_body_free(solids[1].body, NULL);
  }
  nsvcd_body_free(solids[0].body, NULL);
  return 0;
}
