// scene.h - meshes, bodies and questions for the fuzz targets, and what an answer must keep to. Only
// what is public is used. After main.h.
#ifndef NSVCD_TESTS_FUZZ_SCENE_H
#define NSVCD_TESTS_FUZZ_SCENE_H

#include "../../neuralsvcd.h"
#include "../../examples/scenery/status_of.h"

// ------------------------------------------------------------------------------------------- bodies

enum { SCENE_MOST_TRIANGLES = 2048 };

typedef struct scene_mesh {
  float positions[9 * SCENE_MOST_TRIANGLES];
  uint32_t indices[3 * SCENE_MOST_TRIANGLES];
  nsvcd_mesh mesh;
} scene_mesh;

static void scene_box(scene_mesh *out, float x, float y, float z) {
  static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  for (int i = 0; i < 8; i++) {
    out->positions[3 * i] = i & 1 ? x : -x;
    out->positions[3 * i + 1] = i & 2 ? y : -y;
    out->positions[3 * i + 2] = i & 4 ? z : -z;
  }
  memcpy(out->indices, faces, sizeof faces);
  out->mesh.positions = out->positions;
  out->mesh.indices = out->indices;
  out->mesh.vertex_count = 8;
  out->mesh.triangle_count = 12;
}

// A wavy sheet of n by n squares, 0.6 m wide.
static void scene_sheet(scene_mesh *out, uint32_t n) {
  uint32_t *index = out->indices;
  for (uint32_t i = 0; i <= n; i++) {
    for (uint32_t j = 0; j <= n; j++) {
      float *p = out->positions + 3 * (i * (n + 1) + j);
      p[0] = 0.6f * (float)i / (float)n - 0.3f;
      p[1] = 0.6f * (float)j / (float)n - 0.3f;
      p[2] = 0.02f * (float)((i * 7 + j * 5) % 4);
    }
  }
  for (uint32_t i = 0; i < n; i++) {
    for (uint32_t j = 0; j < n; j++) {
      const uint32_t at = i * (n + 1) + j;
      const uint32_t square[6] = {at, at + n + 1, at + n + 2, at, at + n + 2, at + 1};
      memcpy(index, square, sizeof square);
      index += 6;
    }
  }
  out->mesh.positions = out->positions;
  out->mesh.indices = out->indices;
  out->mesh.vertex_count = (size_t)(n + 1) * (n + 1);
  out->mesh.triangle_count = 2 * (size_t)n * n;
}

// A cube, a plate, a needle, a sheet, and one of them for the proof alone, for the network alone and
// without an inside; then a level, far smaller and far larger ones.
enum { SCENE_BODIES = 10 };

static const nsvcd_body *scene_encode(size_t kind) {
  static scene_mesh made;
  static const size_t patches[SCENE_BODIES] = {6, 20, 5, 40, 17, 9, 3, 560, 8, 8};
  nsvcd_encode_options options;
  const nsvcd_body *body = NULL;
  memset(&options, 0, sizeof options);
  options.patches = patches[kind];
  options.no_triangles = kind == 5;
  options.open = kind == 3 || kind == 6;
  options.latents = kind != 4;
  switch (kind) {
    case 1:
      scene_box(&made, 0.2f, 0.2f, 1e-3f);
      break;
    case 2:
      scene_box(&made, 0.3f, 1e-4f, 1e-4f);
      break;
    case 3:
      scene_sheet(&made, 5);
      break;
    case 7:
      scene_sheet(&made, 30);
      break;
    case 8:
      scene_box(&made, 1e-11f, 2e-11f, 1e-11f);
      break;
    case 9:
      scene_box(&made, 3e5f, 2e5f, 9e5f);
      break;
    default:
      scene_box(&made, 0.1f, 0.08f, 0.06f);
  }
  if (nsvcd_encode(&made.mesh, &options, NULL, NULL, 0, &body)) {
    fprintf(stderr, "fuzz: a scene cannot be encoded\n");
    exit(2);
  }
  return body;
}

// Made when it is first asked for, and kept.
static const nsvcd_body *scene_body(size_t kind) {
  static const nsvcd_body *bodies[SCENE_BODIES];
  if (!bodies[kind])
    bodies[kind] = scene_encode(kind);
  return bodies[kind];
}

// ---------------------------------------------------------------------------------------- questions

enum { SCENE_POSES = 6 };

typedef struct scene_question {
  nsvcd_pose a[SCENE_POSES], b[SCENE_POSES];
  float times[2 * SCENE_POSES];
  nsvcd_question question;
} scene_question;

// Mostly a pose as it should be; one of 16 is any numbers.
static void scene_pose(fuzz_input *in, float reach, nsvcd_pose *pose) {
  const uint8_t kind = fuzz_byte(in);
  float square = 0;
  for (int k = 0; k < 3; k++)
    pose->position[k] = reach * fuzz_float(in);
  for (int k = 0; k < 4; k++) {
    pose->rotation[k] = kind % 4 ? fuzz_float(in) : 0;
    square += pose->rotation[k] * pose->rotation[k];
  }
  const float length = sqrtf(square);
  const int turns = length > 1e-3f && length < 1e3f;
  if (kind >= 252)
    return;
  for (int k = 0; k < 4; k++)
    pose->rotation[k] = turns ? pose->rotation[k] / length : (float)(k == 3);
}

// Mostly times that rise; else any numbers.
static void scene_times(fuzz_input *in, size_t count, float *times) {
  const uint8_t kind = fuzz_byte(in);
  float sum = 0;
  for (size_t k = 0; k < count; k++) {
    times[k] = kind < 16 ? fuzz_float(in) : sum;
    sum += kind < 16 ? 0 : 1.0f + fuzz_byte(in);
  }
  if (kind < 16 || count < 2)
    return;
  const float last = times[count - 1];
  for (size_t k = 0; k < count; k++)
    times[k] = k + 1 < count ? times[k] / last : 1;
}

static void scene_mover(fuzz_input *in, float reach, nsvcd_pose *poses, float *times,
                        nsvcd_mover *mover) {
  static const float scales[8] = {0, 1, 0, 1, 0.5f, 3, 1e-6f, 1e6f};
  const uint8_t shape = fuzz_byte(in);
  mover->count = shape % 8 < SCENE_POSES ? shape % 8 : 2;
  mover->scale = shape < 128 ? 0 : shape < 240 ? scales[shape / 8 % 8] : fuzz_float(in);
  for (size_t k = 0; k < mover->count; k++)
    scene_pose(in, reach, &poses[k]);
  mover->poses = mover->count ? poses : NULL;
  if (shape / 8 % 8 == 7) {
    scene_times(in, mover->count, times);
    mover->times = times;
  }
}

// What is asked: all but the bodies.
static void scene_options(fuzz_input *in, nsvcd_question *options) {
  static const size_t pairs[8] = {0, 1, 2, 8, 40, 256, 257, (size_t)-1};
  static const size_t work[8] = {300, 1, 50, 3000, 17, 1000, 300, 300};
  static const float recalls[8] = {0, 0.99f, 0.999f, 0.9999f, 0.5f, 1, -1, 0};
  const uint8_t asked = fuzz_byte(in);
  const uint8_t odd = fuzz_byte(in);
  memset(options, 0, sizeof *options);
  options->work = work[asked % 8];
  options->method = (nsvcd_method)(asked / 8 % 4 == 3 ? odd : asked / 8 % 4);
  if (odd >= 120 && odd < 128)
    options->ask = (nsvcd_ask)(odd % 4);
  if (asked >= 128) {
    options->clearance = fuzz_length(in);
    options->to_time = fuzz_length(in);
    options->to = fuzz_length(in);
    if (options->to > 0)
      options->ask = NSVCD_ASK_DISTANCE;
    if (options->to_time > 0)
      options->ask = NSVCD_ASK_FIRST;
    options->slop = fuzz_length(in);
    options->tolerance = fuzz_length(in);
  }
  if (odd < 128)
    return;
  options->network.pairs = pairs[fuzz_choice(in, 8)];
  options->network.model = (nsvcd_model)(fuzz_choice(in, 32) % 6);
  options->network.precision = (nsvcd_precision)(fuzz_choice(in, 32) % 3);
  options->network.recall = recalls[fuzz_choice(in, 8)];
  options->segments = odd < 240 ? 16 * fuzz_choice(in, 5) : fuzz_byte(in);
}

// A question about two bodies.
static void scene_ask_about(fuzz_input *in, const nsvcd_body *a, const nsvcd_body *b,
                            scene_question *out) {
  static const float reaches[4] = {0.1f, 0.3f, 1, 0};
  memset(out, 0, sizeof *out);
  const float reach = reaches[fuzz_choice(in, 4)];
  scene_options(in, &out->question);
  out->question.a.body = a;
  out->question.b.body = b;
  scene_mover(in, reach, out->a, out->times, &out->question.a);
  scene_mover(in, reach, out->b, out->times + SCENE_POSES, &out->question.b);
}

// ------------------------------------------------------------------------------------------ answers

static int scene_share(float x) {
  return x >= 0 && x <= 1;
}

static int scene_finite(const float *numbers, size_t count) {
  for (size_t k = 0; k < count; k++) {
    if (!(fabsf(numbers[k]) <= 3.4e38f))
      return 0;
  }
  return 1;
}

// 0 or a unit vector?
static int scene_normal(const float *n) {
  const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  return square <= 0 || fabsf(square - 1) < 1e-3f;
}

static void scene_check_proof(const nsvcd_question *question, const nsvcd_answer *answer) {
  const int meets = status_of(answer) == STATUS_WITNESS;
  FUZZ_CHECK(answer->by == NSVCD_BY_PROOF);
  FUZZ_CHECK(answer->verdict != NSVCD_UNDECIDED || answer->why);
  FUZZ_CHECK((int)answer->contact_count == meets);
  FUZZ_CHECK(!(answer->distance.low > answer->distance.high));
  FUZZ_CHECK(answer->distance.low >= 0 && answer->distance.low < HUGE_VALF);
  if (answer->verdict == NSVCD_FREE)
    FUZZ_CHECK(answer->time.low >= 1);
  if (meets) {
    const nsvcd_body_facts a = nsvcd_body_describe(question->a.body);
    const nsvcd_body_facts b = nsvcd_body_describe(question->b.body);
    FUZZ_CHECK(answer->nearest.triangle_a < a.triangles && answer->nearest.triangle_b < b.triangles);
    FUZZ_CHECK(answer->time.low <= answer->nearest.time);
    FUZZ_CHECK(question->ask == NSVCD_ASK_FIRST || answer->time.low <= 0);
    FUZZ_CHECK(!(answer->time.high < answer->nearest.time) &&
               !(answer->time.high > answer->nearest.time));
    FUZZ_CHECK(!memcmp(&answer->contacts[0], &answer->nearest, sizeof answer->nearest));
  }
}

// What nsvcd_answer says of its fields.
static void scene_check(const nsvcd_question *question, const nsvcd_answer *answer) {
  const nsvcd_body_facts a = nsvcd_body_describe(question->a.body);
  const nsvcd_body_facts b = nsvcd_body_describe(question->b.body);
  const nsvcd_method method = question->method;
  const int proves = method != NSVCD_METHOD_NETWORK && a.triangles && b.triangles;
  const nsvcd_contact *nearest = &answer->nearest;
  const nsvcd_opinion *opinion = &answer->opinion;
  FUZZ_CHECK(scene_finite(&opinion->logit, 1) && scene_share(opinion->time));
  FUZZ_CHECK(opinion->patch_a < a.patches && opinion->patch_b < b.patches);
  FUZZ_CHECK(scene_share(nearest->time) && scene_share(answer->time.low));
  FUZZ_CHECK(answer->time.high >= answer->time.low);
  FUZZ_CHECK(nearest->patch_a < a.patches && nearest->patch_b < b.patches);
  FUZZ_CHECK(nearest->triangle_a < a.triangles || nearest->triangle_a == NSVCD_NO_TRIANGLE);
  FUZZ_CHECK(nearest->triangle_b < b.triangles || nearest->triangle_b == NSVCD_NO_TRIANGLE);
  FUZZ_CHECK((unsigned)answer->verdict <= (unsigned)NSVCD_HIT);
  FUZZ_CHECK(nearest->gap >= 0 && answer->contact_count <= NSVCD_MAX_CONTACTS);
  FUZZ_CHECK(!answer->inside || answer->verdict == NSVCD_HIT);
  FUZZ_CHECK(scene_share(answer->safe.time));
  FUZZ_CHECK(scene_finite(answer->safe.a.position, 3) && scene_finite(answer->safe.a.rotation, 4));
  FUZZ_CHECK(scene_finite(answer->safe.b.position, 3) && scene_finite(answer->safe.b.rotation, 4));
  FUZZ_CHECK(scene_finite(nearest->point, 3) && scene_finite(answer->push_out, 3));
  FUZZ_CHECK(scene_normal(nearest->normal));
  if (status_of(answer) == STATUS_WITNESS)
    FUZZ_CHECK(logit_of(answer) >= NSVCD_LOGIT_CERTAIN);
  if (status_of(answer) == STATUS_CERTIFIED_FREE)
    FUZZ_CHECK(logit_of(answer) <= -NSVCD_LOGIT_CERTAIN);
  if (answer->inside) {
    FUZZ_CHECK(logit_of(answer) >= NSVCD_LOGIT_CERTAIN);
    FUZZ_CHECK(answer->time.high <= 0);
  }
  if (proves) {
    scene_check_proof(question, answer);
  } else {
    FUZZ_CHECK(opinion->asked);
    FUZZ_CHECK(status_of(answer) != STATUS_WITNESS);
    FUZZ_CHECK(answer->verdict != NSVCD_UNDECIDED);
  }
}

static int scene_same_contact(const nsvcd_contact *p, const nsvcd_contact *q) {
  return memcmp(p, q, sizeof *p) == 0;  // nothing but fields of four bytes
}

static int scene_same(const nsvcd_answer *p, const nsvcd_answer *q) {
  const nsvcd_opinion *x = &p->opinion;
  const nsvcd_opinion *y = &q->opinion;
  if (p->verdict != q->verdict || p->by != q->by || p->why != q->why || p->work != q->work)
    return 0;
  if (p->inside != q->inside || p->contact_count != q->contact_count)
    return 0;
  for (size_t k = 0; k < p->contact_count; k++) {
    if (!scene_same_contact(&p->contacts[k], &q->contacts[k]))
      return 0;
  }
  if (x->asked != y->asked || x->limited != y->limited || x->candidates != y->candidates)
    return 0;
  if (x->patch_a != y->patch_a || x->patch_b != y->patch_b)
    return 0;
  return memcmp(&x->logit, &y->logit, sizeof x->logit) == 0 &&
         memcmp(&x->time, &y->time, sizeof x->time) == 0 &&
         memcmp(&p->time, &q->time, sizeof p->time) == 0 &&
         memcmp(&p->distance, &q->distance, sizeof p->distance) == 0 &&
         memcmp(&p->safe, &q->safe, sizeof p->safe) == 0 &&
         memcmp(p->push_out, q->push_out, sizeof p->push_out) == 0 &&
         scene_same_contact(&p->nearest, &q->nearest);
}

// -------------------------------------------------------------------------------------------- asked

// The workspace holds `fill` before.
static nsvcd_result scene_sweep(const nsvcd_question *question, size_t size, int fill,
                                nsvcd_answer *answer) {
  void *workspace = malloc(size);  // to the byte
  if (!workspace)
    exit(2);
  memset(workspace, fill, size);
  memset(answer, 0x5a, sizeof *answer);
  const nsvcd_result result = nsvcd_sweep(question, workspace, size, answer);
  free(workspace);
  return result;
}

static void scene_refused(const nsvcd_question *question, size_t size, nsvcd_result wanted) {
  nsvcd_answer untouched;
  nsvcd_answer answer;
  memset(&untouched, 0x5a, sizeof untouched);
  const nsvcd_result result = scene_sweep(question, size, 0, &answer);
  FUZZ_CHECK(result != NSVCD_OK);
  FUZZ_CHECK(wanted ? result == wanted : result != NSVCD_ERROR_WORKSPACE);
  FUZZ_CHECK(memcmp(&answer, &untouched, sizeof answer) == 0);
}

#ifndef NSVCD_NO_GRADIENT
static void scene_check_gradient(const nsvcd_question *question) {
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  const size_t rows_a = question->a.count ? question->a.count : 1;
  const size_t rows_b = question->b.count ? question->b.count : 1;
  nsvcd_answer answer;
  void *workspace = malloc(size);
  float *a = (float *)calloc(6 * rows_a, sizeof *a);
  float *b = (float *)calloc(6 * rows_b, sizeof *b);
  if (!workspace || !a || !b)
    exit(2);
  if (!nsvcd_sweep_gradient(question, workspace, size, &answer, a, b))
    FUZZ_CHECK(scene_finite(a, 6 * rows_a) && scene_finite(b, 6 * rows_b));
  free(workspace);
  free(a);
  free(b);
}
#endif

// Asks, in all ways, and checks what is answered. 1 if there is an answer.
static int scene_ask(const nsvcd_question *question, nsvcd_answer *answer) {
  const size_t size = nsvcd_sweep_workspace_size(question);
  nsvcd_answer again;
  if (size == 0) {
    scene_refused(question, nsvcd_sweep_workspace_size(NULL), NSVCD_OK);
    return 0;
  }
  FUZZ_CHECK(size <= nsvcd_sweep_workspace_size(NULL));
  scene_refused(question, size - 1, NSVCD_ERROR_WORKSPACE);
  FUZZ_CHECK(!scene_sweep(question, size, 0, answer));
  scene_check(question, answer);
  FUZZ_CHECK(!scene_sweep(question, size, 0xff, &again));
  FUZZ_CHECK(scene_same(answer, &again));

  nsvcd_question turned = *question;
  turned.a = question->b;
  turned.b = question->a;
  FUZZ_CHECK(nsvcd_sweep_workspace_size(&turned) == size);
  FUZZ_CHECK(!scene_sweep(&turned, size, 0, &again));
  scene_check(&turned, &again);
  FUZZ_CHECK(again.verdict == answer->verdict && again.inside == answer->inside);
#ifndef NSVCD_NO_GRADIENT
  if (question->method == NSVCD_METHOD_NETWORK)
    scene_check_gradient(question);
#endif
  return 1;
}

#endif
