// Small planning problems with few iterations: refused with a code, or answered as nsvcd_plan_answer
// says, and the same again.
#define FUZZ_TARGET "plan"
#define FUZZ_TOKENS
#include "main.h"

#include "scene.h"

enum { JOINTS = 3, BODIES = 3, PAIRS = 4, MOST_BYTES = 1 << 26 };

// What `place` does wrong, and from which joint on.
typedef struct faults {
  uint8_t kind;
  float from;
} faults;

typedef struct scene {
  nsvcd_plan_problem problem;
  nsvcd_plan_options options;
  float low[JOINTS], high[JOINTS], start[JOINTS], goal[JOINTS];
  const nsvcd_body *bodies[BODIES];
  nsvcd_body_pair pairs[PAIRS];
  faults faults;
  size_t joints, reports, cancel_at;
} scene;

// Body 0 slides, body 1 turns with the last joint, body 2 rests.
static void place(void *user, const float *joints, nsvcd_pose *poses) {
  const scene *s = (const scene *)user;
  const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  for (size_t k = 0; k < BODIES; k++)
    poses[k] = origin;
  for (size_t k = 0; k < s->joints; k++)
    poses[0].position[k] = joints[k];
  poses[1].position[0] = 0.5f;
  poses[1].rotation[2] = sinf(joints[s->joints - 1] / 2);
  poses[1].rotation[3] = cosf(joints[s->joints - 1] / 2);
  if (s->faults.kind < 240 || !(joints[0] > s->faults.from))
    return;
  if (s->faults.kind % 2)
    poses[0].position[1] = fuzz_of_bits(fuzz_numbers[s->faults.kind % 24]);
  else
    poses[0].rotation[3] = fuzz_of_bits(fuzz_numbers[s->faults.kind % 24]);
}

static int report(void *user, const nsvcd_plan_progress *progress) {
  scene *s = (scene *)user;
  FUZZ_CHECK(progress->control && progress->via_points <= NSVCD_MAX_VIA_POINTS);
  return ++s->reports == s->cancel_at;
}

static void read_stage(fuzz_input *in, nsvcd_plan_stage *stage) {
  static const size_t odd[8] = {NSVCD_NONE, 33, 4097, 100001, 10001, 32, 4096, (size_t)-2};
  const uint8_t kind = fuzz_byte(in);
  stage->via_points = fuzz_choice(in, 6);
  stage->segments = 1 + fuzz_choice(in, 6);
  stage->iterations = kind % 8 == 1 ? NSVCD_NONE : 1 + (size_t)kind % 3;
  stage->draws = 1 + fuzz_choice(in, 5);
  if (kind % 4 == 3)
    stage->noise = fuzz_float(in);
  if (kind == 255)
    stage->via_points = odd[fuzz_choice(in, 8)];
  if (kind == 254)
    stage->segments = odd[fuzz_choice(in, 6)];
  if (kind == 253)
    stage->draws = odd[fuzz_choice(in, 5)];
}

static void read_options(fuzz_input *in, nsvcd_plan_options *options) {
  memset(options, 0, sizeof *options);
  const uint8_t kind = fuzz_byte(in);
  options->seed = fuzz_byte(in);
  options->seeds = 1 + fuzz_choice(in, 2);
  read_stage(in, &options->explore);
  read_stage(in, &options->refine);
  options->discrete = kind % 4 == 1;
  options->check = fuzz_choice(in, 12);
  scene_options(in, &options->sweep);
  if (kind < 192)
    memset(&options->sweep, 0, sizeof options->sweep);
  options->sweep.work = 1000;
  if (kind % 8 != 3)
    return;
  float *weights[6] = {&options->velocity,  &options->acceleration, &options->jerk,
                       &options->collision, &options->duration,     &options->margin};
  for (int k = 0; k < 6; k++)
    *weights[k] = 10 * fuzz_float(in);
}

static void read_scene(fuzz_input *in, scene *s) {
  memset(s, 0, sizeof *s);
  nsvcd_plan_problem *p = &s->problem;
  const uint8_t kind = fuzz_byte(in);
  s->joints = 1 + fuzz_choice(in, JOINTS);
  for (size_t k = 0; k < s->joints; k++) {
    const int any = kind >= 224;
    s->low[k] = any ? fuzz_float(in) : -1;
    s->high[k] = any ? fuzz_float(in) : 1;
    s->start[k] = fuzz_float(in) / (any ? 1 : 2);
    s->goal[k] = fuzz_float(in) / (any ? 1 : 2);
  }
  for (size_t k = 0; k < BODIES; k++) {
    const uint8_t body = fuzz_byte(in);
    s->bodies[k] = body < 250 ? scene_body(body % 7) : NULL;
  }
  p->pair_count = fuzz_choice(in, PAIRS + 1);
  for (size_t k = 0; k < p->pair_count; k++) {
    const uint8_t pair = fuzz_byte(in);
    s->pairs[k].a = pair % 4;
    s->pairs[k].b = pair / 4 % 4;
    if (pair < 240) {
      s->pairs[k].a = pair % 2;
      s->pairs[k].b = 2 - pair / 2 % 2 * (1 - pair % 2);
    }
  }
  s->faults.kind = fuzz_byte(in);
  s->faults.from = fuzz_float(in);
  s->cancel_at = kind % 16 == 5 ? 1 + fuzz_choice(in, 6) : 0;
  p->joints = s->joints;
  p->low = s->low;
  p->high = s->high;
  p->start = s->start;
  p->goal = s->goal;
  p->bodies = s->bodies;
  p->body_count = BODIES;
  p->pairs = s->pairs;
  p->kinematics = place;
  p->progress = report;
  p->user = s;
  read_options(in, &s->options);
}

static void check_answer(const scene *s, const nsvcd_plan_answer *answer, const float *control) {
  const size_t rows = answer->via_points + 2;
  const nsvcd_plan_stage *last = &s->options.refine;
  if (last->iterations == NSVCD_NONE)
    last = &s->options.explore;
  FUZZ_CHECK((unsigned)answer->status <= (unsigned)NSVCD_PLAN_GOAL);
  FUZZ_CHECK(answer->via_points <= NSVCD_MAX_VIA_POINTS);
  FUZZ_CHECK(last->via_points == 0 || answer->via_points == last->via_points);
  FUZZ_CHECK(scene_finite(control, rows * s->joints));
  FUZZ_CHECK(scene_share(answer->time));
  FUZZ_CHECK(scene_finite(&answer->cost, 1) && scene_finite(&answer->smoothness, 1));
  FUZZ_CHECK(scene_finite(&answer->deviation, 1) && answer->deviation >= 0);
  FUZZ_CHECK(answer->joint < s->joints || answer->joint == NSVCD_NONE);
  FUZZ_CHECK(answer->pair < s->problem.pair_count || answer->pair == NSVCD_NONE);
  for (size_t k = 0; k < s->joints; k++) {
    FUZZ_CHECK(!(control[k] < s->start[k]) && !(control[k] > s->start[k]));
    const float end = control[(rows - 1) * s->joints + k];
    FUZZ_CHECK(!(end < s->goal[k]) && !(end > s->goal[k]));
  }
  if (answer->status != NSVCD_PLAN_CONVERGED)
    return;
  FUZZ_CHECK(!answer->collides && answer->joint == NSVCD_NONE);
  for (size_t k = 0; k < rows * s->joints; k++) {
    const size_t joint = k % s->joints;
    FUZZ_CHECK(control[k] >= s->low[joint] && control[k] <= s->high[joint]);
  }
}

typedef struct outcome {
  nsvcd_result result;
  nsvcd_plan_answer answer;
  float control[(NSVCD_MAX_VIA_POINTS + 2) * JOINTS];
} outcome;

static void run(scene *s, size_t size, int fill, outcome *out) {
  void *workspace = malloc(size);
  if (!workspace)
    exit(2);
  memset(workspace, fill, size);
  memset(out, 0x5a, sizeof *out);
  s->reports = 0;
  out->result = nsvcd_plan(&s->problem, &s->options, workspace, size, out->control, &out->answer);
  free(workspace);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static scene s;
  static outcome first, second, untouched;
  fuzz_input in = {data, size};
  read_scene(&in, &s);
  const size_t bytes = nsvcd_plan_workspace_size(&s.problem, &s.options);
  if (bytes > MOST_BYTES)
    return 0;
  memset(&untouched, 0x5a, sizeof untouched);
  run(&s, bytes ? bytes : 1 << 20, 0, &first);
  FUZZ_CHECK(bytes > 0 || first.result);
  FUZZ_CHECK(first.result != NSVCD_ERROR_WORKSPACE);
  if (first.result) {
    FUZZ_CHECK(memcmp(&first.answer, &untouched.answer, sizeof first.answer) == 0);
    FUZZ_CHECK(memcmp(first.control, untouched.control, sizeof first.control) == 0);
    return 0;
  }
  fuzz_taken++;
  check_answer(&s, &first.answer, first.control);
  run(&s, bytes, 0xff, &second);
  FUZZ_CHECK(!second.result && first.answer.status == second.answer.status);
  FUZZ_CHECK(memcmp(first.control, second.control, sizeof first.control) == 0);
  run(&s, bytes - 1, 0, &second);
  FUZZ_CHECK(second.result == NSVCD_ERROR_WORKSPACE);
  return 0;
}
