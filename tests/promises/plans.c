// What src/interface/plans.h promises, a test each: a smooth trajectory that is free, or why not.
#include "scene.h"

void promises_plans(void);

// A crate slides over the floor, x and y its joints, from one side of a wall to the other.
#define JOINTS 2
static const float low[JOINTS] = {-2, -2}, high[JOINTS] = {2, 2};
static const float from[JOINTS] = {-1, 0.1f}, to[JOINTS] = {1, 0.1f};
static const nsvcd_body_pair crate_and_wall[1] = {{0, 1}};

static size_t places;  // asked for
static void place(void *user, const float *joints, nsvcd_pose *poses) {
  (void)user;
  places++;
  poses[0] = at(joints[0], joints[1], 0);
  poses[1] = at(0, 0, 0);
}

typedef struct floor_plan {
  const nsvcd_body *bodies[2];
  nsvcd_plan_problem problem;
} floor_plan;

static void floor_open(floor_plan *f) {
  const nsvcd_encode_options options = {.latents = 1};
  memset(f, 0, sizeof *f);
  f->bodies[0] = body_of(box_mesh(0.4f, 0.4f, 0.4f), &options);
  f->bodies[1] = body_of(box_mesh(0.1f, 1, 1), &options);
  f->problem = (nsvcd_plan_problem){.joints = JOINTS,
                                    .low = low,
                                    .high = high,
                                    .start = from,
                                    .goal = to,
                                    .bodies = f->bodies,
                                    .body_count = 2,
                                    .pairs = crate_and_wall,
                                    .pair_count = 1,
                                    .kinematics = place};
}
static void floor_close(floor_plan *f) {
  nsvcd_body_free(f->bodies[0], NULL);
  nsvcd_body_free(f->bodies[1], NULL);
}

// Whatever the workspace holds.
static nsvcd_plan_answer plan_with(const nsvcd_plan_problem *problem,
                                   const nsvcd_plan_options *options, int junk, float *control) {
  const size_t size = nsvcd_plan_workspace_size(problem, options);
  void *workspace = malloc(size);
  nsvcd_plan_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK(size > 0);
  memset(workspace, junk, size);
  CHECK_EQ(nsvcd_plan(problem, options, workspace, size, control, &answer), NSVCD_OK);
  free(workspace);
  return answer;
}
static nsvcd_plan_answer plan_of(const nsvcd_plan_problem *problem, float *control) {
  return plan_with(problem, NULL, 0x5a, control);
}

static void a_spline_passes_through_its_points_and_rests_at_both_ends(void) {
  enum { MOST = NSVCD_MAX_VIA_POINTS + 2 };
  for (size_t via = 0; via <= NSVCD_MAX_VIA_POINTS; via++) {
    const double last = (double)(via + 1);
    float control[3 * MOST], x[3];
    for (size_t i = 0; i < 3 * (via + 2); i++) control[i] = 2 * sinf(7.0f * (float)(i * i));
    for (size_t k = 0; k < via + 2; k++) {
      nsvcd_spline(control, via, 3, (float)((double)k / last), 0, x);
      for (size_t j = 0; j < 3; j++) CHECK_NEAR(x[j], control[3 * k + j], 1e-4);
    }
    for (size_t derivative = 1; derivative <= 2; derivative++) {
      for (int end = 0; end < 2; end++) {
        nsvcd_spline(control, via, 3, (float)end, derivative, x);
        for (size_t j = 0; j < 3; j++) CHECK_NEAR(x[j], 0, 1e-9 * pow(last, (double)derivative));
      }
    }
    for (int end = 0; end < 2; end++) {  // t is taken into [0,1]
      nsvcd_spline(control, via, 3, end ? 7.0f : -3.0f, 0, x);
      for (size_t j = 0; j < 3; j++) CHECK_EQ(x[j], control[3 * (end ? via + 1 : 0) + j]);
    }
    // Points that are all the same are a spline that stands still.
    for (size_t i = 0; i < 3 * (via + 2); i++) control[i] = i % 3 ? 1.25f : -3;
    for (size_t n = 0; n < 80; n++) {
      const size_t derivative = n % 4;
      nsvcd_spline(control, via, 3, (float)n / 79, derivative, x);
      for (size_t j = 0; j < 3; j++)
        CHECK_NEAR(x[j], derivative ? 0 : control[j], 1e-6 * pow(last, (double)derivative));
    }
  }
  float x = 7, control[2] = {0, 1};
  nsvcd_spline(control, 0, 1, 0.5f, 4, &x);  // there is no fourth derivative,
  nsvcd_spline(control, 0, 1, 0.5f, SIZE_MAX, &x);
  nsvcd_spline(control, NSVCD_MAX_VIA_POINTS + 1, 1, 0.5f, 0, &x);  // nor room for one more
  CHECK_EQ(x, 7);
}

// The spline at many times, asked about as one motion: its way leads round the wall.
static void a_plan_that_converged_is_free(void) {
  enum { POSES = 512 };
  static nsvcd_pose poses[POSES];
  float control[JOINTS * (NSVCD_MAX_VIA_POINTS + 2)];
  floor_plan f;
  floor_open(&f);
  const nsvcd_plan_answer answer = plan_of(&f.problem, control);
  CHECK(answer.status == NSVCD_PLAN_CONVERGED && !answer.collides && answer.deviation < 1e-3f);
  for (int i = 0; i < POSES; i++) {
    float joints[JOINTS];
    nsvcd_spline(control, answer.via_points, JOINTS, (float)i / (POSES - 1), 0, joints);
    for (int k = 0; k < JOINTS; k++) CHECK(joints[k] >= low[k] && joints[k] <= high[k]);
    poses[i] = at(joints[0], joints[1], 0);
  }
  for (int k = 0; k < JOINTS; k++) {
    CHECK_NEAR(poses[0].position[k], from[k], 1e-6);
    CHECK_NEAR(poses[POSES - 1].position[k], to[k], 1e-6);
  }
  const nsvcd_question question = question_about(f.bodies[0], poses, POSES, f.bodies[1]);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  floor_close(&f);
}

// Of poses, not sweeps, and by the second stage alone.
static void stages_can_be_left_out_and_poses_asked_about_instead(void) {
  const nsvcd_plan_options options = {
      .discrete = 1, .explore = {.iterations = NSVCD_NONE}, .refine = {.via_points = 3}};
  static const float beside[JOINTS] = {-1, 1.2f}, across[JOINTS] = {1, 1.2f};
  float control[JOINTS * (NSVCD_MAX_VIA_POINTS + 2)];
  nsvcd_plan_answer answer;
  floor_plan f;
  floor_open(&f);
  f.problem.start = beside;
  f.problem.goal = across;
  const size_t size = nsvcd_plan_workspace_size(&f.problem, &options);
  void *workspace = malloc(size);
  CHECK_EQ(nsvcd_plan(&f.problem, &options, workspace, size, control, &answer), NSVCD_OK);
  CHECK(answer.status == NSVCD_PLAN_CONVERGED && answer.via_points == 3);
  free(workspace);
  floor_close(&f);
}

static void the_same_problem_is_the_same_plan(void) {
  nsvcd_plan_options options = {.seed = 1};
  float control[3][JOINTS * (NSVCD_MAX_VIA_POINTS + 2)];
  floor_plan f;
  floor_open(&f);
  const nsvcd_plan_answer first = plan_with(&f.problem, &options, 0, control[0]);
  const nsvcd_plan_answer again = plan_with(&f.problem, &options, 0xff, control[1]);
  const size_t size = JOINTS * (first.via_points + 2) * sizeof(float);
  CHECK_EQ(first.via_points, again.via_points);
  CHECK(!memcmp(control[0], control[1], size));
  options.seed = 2;  // other random numbers, another way
  plan_with(&f.problem, &options, 0, control[2]);
  CHECK(memcmp(control[0], control[2], size) != 0);
  floor_close(&f);
}

static void a_start_or_a_goal_that_is_not_free_is_told(void) {
  static const float inside[JOINTS] = {0, 0.2f}, outside[JOINTS] = {1, 2.5f};
  float control[JOINTS * (NSVCD_MAX_VIA_POINTS + 2)];
  floor_plan f;
  floor_open(&f);
  f.problem.start = inside;
  nsvcd_plan_answer answer = plan_of(&f.problem, control);
  CHECK(answer.status == NSVCD_PLAN_START && answer.collides && answer.pair == 0);
  f.problem.start = from;
  f.problem.goal = outside;
  answer = plan_of(&f.problem, control);
  CHECK(answer.status == NSVCD_PLAN_GOAL && answer.joint == 1);
  CHECK(strlen(nsvcd_plan_status_string(answer.status)) > 3);
  floor_close(&f);
}

// After so many reports, in either stage.
typedef struct patience {
  size_t reports, most;
} patience;
static int loses_patience(void *user, const nsvcd_plan_progress *progress) {
  patience *p = (patience *)user;
  CHECK(progress->control != NULL);
  return ++p->reports == p->most;
}
static void a_plan_can_be_cancelled(void) {
  const nsvcd_plan_options options = {.explore = {.iterations = 3, .draws = 40}};
  float control[JOINTS * (NSVCD_MAX_VIA_POINTS + 2)];
  floor_plan f;
  floor_open(&f);
  for (size_t most = 1; most < 7; most++) {
    patience p = {0, most};
    f.problem.progress = loses_patience;
    f.problem.user = &p;
    const nsvcd_plan_answer answer = plan_with(&f.problem, &options, 0x5a, control);
    CHECK_EQ(answer.status, NSVCD_PLAN_CANCELLED);
    CHECK(p.reports == most && answer.iterations == most);
  }
  floor_close(&f);
}

// Nothing is written then, and no place asked for.
static void a_plan_is_refused_by_the_field_at_fault(void) {
  float control[JOINTS * (NSVCD_MAX_VIA_POINTS + 2)], kept[JOINTS * (NSVCD_MAX_VIA_POINTS + 2)];
  nsvcd_plan_answer answer, before;
  floor_plan f;
  floor_open(&f);
  const size_t size = nsvcd_plan_workspace_size(&f.problem, NULL);
  char *workspace = (char *)malloc(size + 8);
  memset(control, 7, sizeof control);
  memset(&answer, 7, sizeof answer);
  memcpy(kept, control, sizeof kept);
  before = answer;
  const nsvcd_plan_problem good = f.problem;
  places = 0;
  nsvcd_plan_problem *p = &f.problem;
#define REFUSED(code, at, room, change)                                                     \
  do {                                                                                      \
    change;                                                                                 \
    CHECK_EQ(nsvcd_plan(p, NULL, at, room, control, &answer), code);                        \
    CHECK(!memcmp(control, kept, sizeof kept) && !memcmp(&answer, &before, sizeof before)); \
    *p = good;                                                                              \
  } while (0)
  REFUSED(NSVCD_ERROR_WORKSPACE, workspace, size - 1, (void)0);
  REFUSED(NSVCD_ERROR_WORKSPACE, workspace + 4, size, (void)0);
  REFUSED(NSVCD_ERROR_WORKSPACE, NULL, size, (void)0);
  REFUSED(NSVCD_ERROR_LIMITS, workspace, size, (p->low = high, p->high = low));
  REFUSED(NSVCD_ERROR_COUNT, workspace, size, p->joints = NSVCD_MAX_JOINTS + 1);
  REFUSED(NSVCD_ERROR_PAIR, workspace, size, p->body_count = 1);
  REFUSED(NSVCD_ERROR_ARGUMENT, workspace, size, p->start = NULL);
#undef REFUSED
  CHECK_EQ(places, 0);
  CHECK_EQ(nsvcd_plan(NULL, NULL, workspace, size, control, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_plan(p, NULL, workspace, size, NULL, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_plan(p, NULL, workspace, size, control, NULL), NSVCD_ERROR_ARGUMENT);
  p->joints = 0;
  CHECK_EQ(nsvcd_plan_workspace_size(p, NULL), 0);
  free(workspace);
  floor_close(&f);
}

void promises_plans(void) {
  RUN(a_spline_passes_through_its_points_and_rests_at_both_ends);
  RUN(a_plan_that_converged_is_free);
  RUN(stages_can_be_left_out_and_poses_asked_about_instead);
  RUN(the_same_problem_is_the_same_plan);
  RUN(a_start_or_a_goal_that_is_not_free_is_told);
  RUN(a_plan_can_be_cancelled);
  RUN(a_plan_is_refused_by_the_field_at_fault);
}

CHECK_ALONE(promises_plans)
