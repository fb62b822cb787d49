// What src/interface/reaches.h promises, a test each: configurations that have a tool where it is to be.
#include "arm.h"

void promises_reaches(void);

// The arm's tip is to be at a point of the plane, turned about z in any way.
static nsvcd_reach_problem tip_to(const double *start, float x, float y) {
  const nsvcd_reach_problem problem = {.start = start,
                                       .link = 2,
                                       .tool = at(1, 0, 0),
                                       .target = at(x, y, 0),
                                       .free_axis = {0, 0, 1}};
  return problem;
}
static void tip_of(const double *q, double *tip) {
  tip[0] = 1.1 * cos(q[0]) + cos(q[0] + q[1]);
  tip[1] = 1.1 * sin(q[0]) + sin(q[0] + q[1]);
}

// Elbow up and elbow down: the way that the start's elbow is, is the first.
static void a_tool_is_at_its_target_in_every_way_there_is(void) {
  arm a;
  arm_open(&a, at(0, -5, 0));
  for (int side = -1; side <= 1; side += 2) {
    const double start[ARM_JOINTS] = {0, side * 0.9};
    const nsvcd_reach_problem problem = tip_to(start, 1.2f, 0.8f);
    double out[4][ARM_JOINTS], tip[2];
    nsvcd_reach_answer answer;
    CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out[0], 4, &answer), NSVCD_OK);
    CHECK(answer.solutions == 2 && answer.touching == 0 && answer.starts >= 26);
    CHECK(side * out[0][1] > 0.5 && side * out[1][1] < -0.5);
    CHECK_EQ(memcmp(answer.best, out[0], sizeof out[0]), 0);
    for (int n = 0; n < 2; n++) {
      tip_of(out[n], tip);
      CHECK_NEAR(hypot(tip[0] - (double)1.2f, tip[1] - (double)0.8f), 0, 2e-6);
      CHECK(fabs(out[n][0]) <= 3 && fabs(out[n][1]) <= 3);
    }
    // one is enough, if no more is asked for
    CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out[0], 1, &answer), NSVCD_OK);
    CHECK(answer.solutions == 1 && answer.starts == 1 && side * out[0][1] > 0.5);
  }
  arm_close(&a);
}

// The post is where the upper arm goes with the elbow down; then the tip touches it both ways.
static void what_is_found_is_free_and_what_touches_is_told(void) {
  const double start[ARM_JOINTS] = {0, 0.9};
  const nsvcd_reach_problem problem = tip_to(start, 1.2f, 0.8f);
  const nsvcd_reach_options anyhow = {.may_touch = 1};
  double out[4][ARM_JOINTS];
  nsvcd_reach_answer answer;
  arm a;
  arm_open(&a, at(0.6f, 0, 0));
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out[0], 4, &answer), NSVCD_OK);
  CHECK(answer.solutions == 1 && answer.touching > 0 && out[0][1] < 0);
  CHECK_EQ(verdict_at(&a, out[0]), NSVCD_FREE);
  CHECK_EQ(nsvcd_reach(a.checker, &problem, &anyhow, out[0], 4, &answer), NSVCD_OK);
  CHECK(answer.solutions == 2 && answer.touching == 0);
  arm_close(&a);
  arm_open(&a, at(1.2f, 0.8f, 0));
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out[0], 4, &answer), NSVCD_OK);
  CHECK(answer.solutions == 0 && answer.reached == answer.touching && answer.touching > 0);
  CHECK(answer.check.verdict == NSVCD_HIT && answer.check.pair == FORE && answer.best[1] > 0);
  CHECK_EQ(verdict_at(&a, answer.best), NSVCD_HIT);
  arm_close(&a);
}

static void what_is_out_of_reach_is_told_by_how_much(void) {
  const double start[ARM_JOINTS] = {0.3, 0.9};
  nsvcd_reach_problem problem = tip_to(start, 2.6f, 0);
  double out[ARM_JOINTS];
  nsvcd_reach_answer answer;
  arm a;
  arm_open(&a, at(0, -5, 0));
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out, 1, &answer), NSVCD_OK);
  CHECK(answer.solutions == 0 && answer.reached == 0);
  CHECK_NEAR(answer.position_error, 0.5, 1e-6);
  for (int k = 0; k < ARM_JOINTS; k++) CHECK_NEAR(answer.best[k], 0, 1e-3);
  // it lies in the plane: it cannot be turned out of that
  problem = tip_to(start, 1.5f, 0);
  problem.target.rotation[0] = sinf(0.25f);
  problem.target.rotation[3] = cosf(0.25f);
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out, 1, &answer), NSVCD_OK);
  CHECK(answer.solutions == 0);
  CHECK_NEAR(answer.angle_error, 0.5, 1e-6);
  arm_close(&a);
}

static void a_tool_may_be_anywhere_in_a_box(void) {
  const double start[ARM_JOINTS] = {0, 0.2};
  nsvcd_reach_problem problem = tip_to(start, 2.6f, 0);
  double out[ARM_JOINTS], tip[2];
  nsvcd_reach_answer answer;
  arm a;
  arm_open(&a, at(0, -5, 0));
  problem.half[0] = 0.6f;
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out, 1, &answer), NSVCD_OK);
  CHECK_EQ(answer.solutions, 1);
  tip_of(out, tip);
  CHECK(tip[0] >= 2 - 2e-6 && tip[0] <= 2.1);
  CHECK_NEAR(tip[1], 0, 2e-6);
  arm_close(&a);
}

static int at_once(void *user) {
  ++*(int *)user;
  return 1;
}

static void a_search_for_a_tool_ends_when_told_and_refuses_by_name(void) {
  const double start[ARM_JOINTS] = {0, 0.2};
  const nsvcd_reach_problem good = tip_to(start, 1.2f, 0.8f);
  nsvcd_reach_problem problem = good;
  nsvcd_reach_options options = {.angle_tolerance = -1};
  double out[ARM_JOINTS];
  nsvcd_reach_answer answer;
  int calls = 0;
  arm a;
  arm_open(&a, at(0, -5, 0));
  problem.stop = at_once;
  problem.user = &calls;
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out, 1, &answer), NSVCD_OK);
  CHECK(calls == 1 && answer.starts == 0 && answer.solutions == 0);
  CHECK_EQ(nsvcd_reach(a.checker, &good, NULL, out, 0, &answer), NSVCD_ERROR_COUNT);
  CHECK_EQ(nsvcd_reach(a.checker, &good, &options, out, 1, &answer), NSVCD_ERROR_TOLERANCE);
  problem = good;
  problem.link = 0;
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out, 1, &answer), NSVCD_ERROR_LINK);
  problem = good;
  problem.target.rotation[3] = 2;
  CHECK_EQ(nsvcd_reach(a.checker, &problem, NULL, out, 1, &answer), NSVCD_ERROR_QUATERNION);
  arm_close(&a);
}

void promises_reaches(void) {
  RUN(a_tool_is_at_its_target_in_every_way_there_is);
  RUN(what_is_found_is_free_and_what_touches_is_told);
  RUN(what_is_out_of_reach_is_told_by_how_much);
  RUN(a_tool_may_be_anywhere_in_a_box);
  RUN(a_search_for_a_tool_ends_when_told_and_refuses_by_name);
}

CHECK_ALONE(promises_reaches)
