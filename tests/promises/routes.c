// What src/interface/routes.h promises, a test each: a way for a robot that is proven, or why not.
#include "arm.h"

void promises_routes(void);

// From one side of the post to the other, which the straight line hits.
static const double from[ARM_JOINTS] = {-0.6, 0}, to[ARM_JOINTS] = {0.6, 0};

static nsvcd_route_answer route_of(const arm *a, const nsvcd_route_problem *problem,
                                   const nsvcd_route_options *options, void **memory) {
  nsvcd_route_answer answer;
  const size_t size = nsvcd_route_size(a->checker, problem, options);
  memset(&answer, 0, sizeof answer);
  CHECK(size > 0);
  *memory = malloc(size);
  CHECK_EQ(nsvcd_route(a->checker, problem, options, *memory, size, &answer), NSVCD_OK);
  return answer;
}

static void a_route_is_free_from_the_start_to_the_goal(void) {
  const nsvcd_route_problem problem = {.start = from, .goals = to, .goal_count = 1};
  const nsvcd_route_options options = {.clearance = 0.01f};
  double there[ARM_JOINTS];
  void *memory;
  arm a;
  arm_open(&a, at(1.8f, 0, 0));
  const nsvcd_route_answer answer = route_of(&a, &problem, &options, &memory);
  CHECK(answer.status == NSVCD_ROUTE_FOUND && answer.goal == 0);
  CHECK_EQ(check_of(&a, &answer.motion, 0.01f).verdict, NSVCD_FREE);
  CHECK_GE(answer.duration, answer.unhindered);
  nsvcd_motion_at(&answer.motion, ARM_JOINTS, 0, there);
  for (int k = 0; k < ARM_JOINTS; k++) CHECK_NEAR(there[k], from[k], 1e-12);
  nsvcd_motion_at(&answer.motion, ARM_JOINTS, answer.duration, there);
  for (int k = 0; k < ARM_JOINTS; k++) CHECK_NEAR(there[k], to[k], 1e-12);
  free(memory);
  arm_close(&a);
}

// By differences: a joint's speed and acceleration are 1 where nothing is said.
static void a_route_keeps_to_the_limits_of_speed_and_acceleration(void) {
  enum { STEPS = 4000 };
  const nsvcd_route_problem problem = {.start = from, .goals = to, .goal_count = 1};
  double last[ARM_JOINTS] = {0, 0}, before[ARM_JOINTS], joints[ARM_JOINTS];
  void *memory;
  arm a;
  arm_open(&a, at(1.8f, 0, 0));
  const nsvcd_route_answer answer = route_of(&a, &problem, NULL, &memory);
  const double step = answer.duration / STEPS;
  nsvcd_motion_at(&answer.motion, ARM_JOINTS, 0, before);
  for (int i = 1; i <= STEPS; i++) {
    nsvcd_motion_at(&answer.motion, ARM_JOINTS, i == STEPS ? answer.duration : step * i, joints);
    for (int k = 0; k < ARM_JOINTS; k++) {
      const double speed = (joints[k] - before[k]) / step;
      CHECK_LE(fabs(speed), 1 + 1e-6);
      CHECK_LE(fabs(speed - last[k]), step * (1 + 1e-3));  // at rest as it begins
      CHECK(fabs(joints[k]) <= 3);
      last[k] = speed;
      before[k] = joints[k];
    }
  }
  for (int k = 0; k < ARM_JOINTS; k++) CHECK_LE(fabs(last[k]), step);  // and as it ends
  free(memory);
  arm_close(&a);
}

// The fore arm turns back by twice as much, and its limits are the upper arm's too.
static void a_joint_follows_the_one_that_it_mimics(void) {
  const double start[ARM_JOINTS] = {-0.6, 1.3}, goal[ARM_JOINTS] = {0.6, -1.1};
  const double broken[ARM_JOINTS] = {0.6, -1.1 + 1e-6};
  nsvcd_route_problem problem = {.start = start, .goals = goal, .goal_count = 1};
  nsvcd_route_answer answer;
  void *memory;
  arm a;
  arm_open(&a, at(9, 0, 0));
  a.joints[FORE].mimic = UPPER + 1;
  a.joints[FORE].multiplier = -2;
  a.joints[FORE].offset = 0.1;
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, nsvcd_checker_size(&a.scene), &a.checker),
           NSVCD_OK);
  answer = route_of(&a, &problem, NULL, &memory);
  CHECK_EQ(answer.status, NSVCD_ROUTE_FOUND);
  CHECK_GE(answer.duration, 2 * sqrt(2.4) * (1 - 1e-9));
  for (int k = 0; k <= 100; k++) {
    double there[ARM_JOINTS];
    nsvcd_motion_at(&answer.motion, ARM_JOINTS, answer.duration * k / 100, there);
    CHECK_NEAR(there[FORE], -2 * there[UPPER] + 0.1, 1e-12);
  }
  free(memory);
  problem.goals = broken;
  CHECK_EQ(nsvcd_route(a.checker, &problem, NULL, NULL, 0, &answer), NSVCD_ERROR_MIMIC);
  a.joints[FORE].multiplier = 0;
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, 1, &a.checker), NSVCD_ERROR_MIMIC);
  arm_close(&a);
}

static void a_joint_that_is_held_stays(void) {
  const uint8_t held[2][ARM_JOINTS] = {{0, 1}, {1, 1}};
  const double aside[ARM_JOINTS] = {0.6, 0.5}, guess[ARM_JOINTS] = {0, 0.1};
  nsvcd_route_problem problem = {.start = from, .goals = to, .goal_count = 1, .held = held[0]};
  const nsvcd_route_options options = {.nodes = 500};
  double there[ARM_JOINTS];
  void *memory;
  arm a;
  // the way round the post bends the arm
  arm_open(&a, at(1.8f, 0, 0));
  CHECK_EQ(route_of(&a, &problem, &options, &memory).status, NSVCD_ROUTE_LIMIT);
  free(memory);
  problem.held = held[1];
  CHECK_EQ(nsvcd_route_size(a.checker, &problem, NULL), 0);
  problem.goals = from;
  CHECK_EQ(route_of(&a, &problem, &options, &memory).status, NSVCD_ROUTE_FOUND);
  free(memory);
  problem.held = held[0];
  problem.goals = aside;
  nsvcd_route_answer answer;
  CHECK_EQ(nsvcd_route(a.checker, &problem, NULL, NULL, 0, &answer), NSVCD_ERROR_HELD);
  problem.goals = to;
  problem.guess = guess;
  problem.guess_count = 1;
  CHECK_EQ(nsvcd_route(a.checker, &problem, NULL, NULL, 0, &answer), NSVCD_ERROR_HELD);
  arm_close(&a);
  // without the post it moves, and that joint does not
  problem.guess_count = 0;
  problem.guess = NULL;
  arm_open(&a, at(9, 0, 0));
  answer = route_of(&a, &problem, NULL, &memory);
  CHECK_EQ(answer.status, NSVCD_ROUTE_FOUND);
  for (int k = 0; k <= 50; k++) {
    nsvcd_motion_at(&answer.motion, ARM_JOINTS, answer.duration * k / 50, there);
    CHECK(!memcmp(&there[1], &from[1], sizeof there[1]));
  }
  free(memory);
  arm_close(&a);
}

static void the_same_seed_is_the_same_route(void) {
  const nsvcd_route_problem problem = {.start = from, .goals = to, .goal_count = 1};
  const nsvcd_route_options options = {.seed = 7};
  nsvcd_route_answer answers[2];
  void *memory[2];
  arm arms[2];
  for (int i = 0; i < 2; i++) {
    arm_open(&arms[i], at(1.8f, 0, 0));
    answers[i] = route_of(&arms[i], &problem, &options, &memory[i]);
  }
  const nsvcd_joint_motion *m = &answers[0].motion;
  const size_t points = ARM_JOINTS * (m->pieces * m->degree + 1);
  CHECK_EQ(answers[1].motion.pieces, m->pieces);
  CHECK(!memcmp(answers[1].motion.points, m->points, points * sizeof(double)));
  for (int i = 0; i < 2; i++) {
    free(memory[i]);
    arm_close(&arms[i]);
  }
}

static void a_start_or_a_goal_that_is_not_free_is_told(void) {
  static const double hit[ARM_JOINTS] = {0, 0}, out[ARM_JOINTS] = {0.6, 3.5};
  nsvcd_route_problem problem = {.start = hit, .goals = to, .goal_count = 1};
  void *memory;
  arm a;
  arm_open(&a, at(1.8f, 0, 0));
  nsvcd_route_answer answer = route_of(&a, &problem, NULL, &memory);
  CHECK(answer.status == NSVCD_ROUTE_START && answer.check.verdict == NSVCD_HIT);
  CHECK_EQ(answer.check.pair, FORE);
  free(memory);
  problem.start = from;
  problem.goals = out;
  answer = route_of(&a, &problem, NULL, &memory);
  CHECK(answer.status == NSVCD_ROUTE_GOAL && answer.check.joint == 1);
  CHECK(strlen(nsvcd_route_status_string(answer.status)) > 3);
  free(memory);
  arm_close(&a);
}

static int at_once(void *user) {
  (void)user;
  return 1;
}
static void a_search_ends_by_its_nodes_and_by_the_caller(void) {
  nsvcd_route_problem problem = {.start = from, .goals = to, .goal_count = 1};
  const nsvcd_route_options options = {.tries = 2};
  void *memory;
  arm a;
  arm_open(&a, at(1.8f, 0, 0));
  CHECK_EQ(route_of(&a, &problem, &options, &memory).status, NSVCD_ROUTE_LIMIT);
  free(memory);
  problem.stop = at_once;
  CHECK_EQ(route_of(&a, &problem, NULL, &memory).status, NSVCD_ROUTE_STOPPED);
  free(memory);
  problem.goal_count = 0;
  CHECK_EQ(nsvcd_route_size(a.checker, &problem, NULL), 0);
  arm_close(&a);
}

// Links with balls: looked at on the way, proven in the end; not looked at where that is not wanted.
static void a_route_by_looks_is_proven(void) {
  const nsvcd_route_problem problem = {.start = from, .goals = to, .goal_count = 1};
  const nsvcd_encode_options covered = {.balls = 64};
  const nsvcd_body *link = body_of(box_mesh(1, 0.1f, 0.1f), &covered);
  void *memory;
  arm a;
  arm_open(&a, at(1.8f, 0, 0));
  for (int k = 0; k < ARM_JOINTS; k++) a.parts[k].body = link;
  for (int k = 0; k < 2; k++) {
    const nsvcd_route_options options = {.clearance = 0.01f, .looks = k ? NSVCD_NONE : 0};
    const size_t size = nsvcd_checker_size(&a.scene);
    CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, size, &a.checker), NSVCD_OK);
    const nsvcd_route_answer answer = route_of(&a, &problem, &options, &memory);
    CHECK_EQ(answer.status, NSVCD_ROUTE_FOUND);
    CHECK_EQ(answer.looks > 0, k == 0);
    CHECK_EQ(check_of(&a, &answer.motion, 0.01f).verdict, NSVCD_FREE);
    free(memory);
  }
  nsvcd_body_free(link, NULL);
  arm_close(&a);
}

void promises_routes(void) {
  RUN(a_route_is_free_from_the_start_to_the_goal);
  RUN(a_route_keeps_to_the_limits_of_speed_and_acceleration);
  RUN(a_joint_that_is_held_stays);
  RUN(a_joint_follows_the_one_that_it_mimics);
  RUN(the_same_seed_is_the_same_route);
  RUN(a_route_by_looks_is_proven);
  RUN(a_start_or_a_goal_that_is_not_free_is_told);
  RUN(a_search_ends_by_its_nodes_and_by_the_caller);
}

CHECK_ALONE(promises_routes)
