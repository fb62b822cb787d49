// What src/interface/ranges.h promises, a test each: do two parts of a robot ever meet?
#include "arm.h"

void promises_ranges(void);

static nsvcd_range_answer range_of(const arm *a, size_t first, size_t second,
                                   const nsvcd_range_options *options) {
  const nsvcd_body_pair pair = {(uint32_t)first, (uint32_t)second};
  const size_t size = nsvcd_pair_range_size(a->checker, pair, options);
  void *memory = malloc(size);
  nsvcd_range_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_pair_range(a->checker, pair, options, memory, size, &answer), NSVCD_OK);
  free(memory);
  return answer;
}

// A post out of reach, one that the upper arm goes through, and one that stands in its joint.
static void parts_meet_never_sometimes_or_always(void) {
  const float places[4] = {2.3f, 1.5f, 0.7f, 0.1f};
  const nsvcd_meeting upper[4] = {NSVCD_MEETS_NEVER, NSVCD_MEETS_NEVER, NSVCD_MEETS_SOMETIMES,
                                  NSVCD_MEETS_SOMETIMES};
  const nsvcd_meeting fore[4] = {NSVCD_MEETS_NEVER, NSVCD_MEETS_SOMETIMES, NSVCD_MEETS_SOMETIMES,
                                 NSVCD_MEETS_SOMETIMES};
  for (int n = 0; n < 4; n++) {
    arm a;
    arm_open(&a, at(places[n], 0, 0));
    const nsvcd_range_answer answers[2] = {range_of(&a, UPPER, POST, NULL),
                                           range_of(&a, POST, FORE, NULL)};
    CHECK_EQ(answers[0].meeting, upper[n]);
    CHECK_EQ(answers[1].meeting, fore[n]);
    CHECK(answers[0].joints == 1 && answers[1].joints == 2);
    for (int k = 0; k < 2; k++) {
      if (answers[k].meeting == NSVCD_MEETS_UNKNOWN) continue;
      CHECK(answers[k].open <= 0 && answers[k].why == NSVCD_WHY_NOTHING);
      if (answers[k].has_free && k) CHECK(answers[k].free[0] <= 3 && answers[k].free[1] <= 3);
    }
    if (answers[0].has_hit) {
      const double *q = answers[0].hit;
      CHECK_EQ(verdict_at(&a, q), NSVCD_HIT);
    }
    arm_close(&a);
  }
  arm a;
  arm_open(&a, at(0.55f, 0, 0));
  a.joints[0].low = -0.05;
  a.joints[0].high = 0.05;
  const nsvcd_range_answer held = range_of(&a, UPPER, POST, NULL);
  CHECK_EQ(held.meeting, NSVCD_MEETS_ALWAYS);
  CHECK_EQ(strcmp(nsvcd_meeting_string(held.meeting), "always"), 0);
  arm_close(&a);
}

// In a box about a configuration, and from it, a post and the forearm come nearer to each other by no
// more than the joints are said to move points.
static void joints_of_a_box_move_points_no_farther(void) {
  const double low[2] = {-0.2, 0.7}, high[2] = {0.2, 0.9};
  const double ends[2] = {high[0], low[1]}, middle[2] = {0, 0.8};
  const nsvcd_body_pair pair = {FORE, POST};
  double moved[2];
  arm a;
  arm_open(&a, at(2.3f, 0, 0));
  CHECK_EQ(nsvcd_pair_travel(a.checker, pair, low, high, moved), NSVCD_OK);
  // the upper arm is 1 m long, and so is the forearm
  CHECK(moved[0] > 0.2 && moved[0] < 0.2 * 2.5);
  CHECK(moved[1] > 0.1 && moved[1] < 0.1 * 1.5);
  nsvcd_pose poses[2][ARM_PARTS];
  nsvcd_forward_kinematics(a.checker, middle, poses[0]);
  nsvcd_forward_kinematics(a.checker, ends, poses[1]);
  double square = 0;
  for (int k = 0; k < 3; k++) {
    const double off = (double)poses[0][FORE].position[k] - (double)poses[1][FORE].position[k];
    square += off * off;
  }
  CHECK(sqrt(square) <= moved[0] + moved[1]);
  CHECK_EQ(nsvcd_pair_travel(a.checker, pair, high, low, moved), NSVCD_ERROR_VALUE);
  CHECK_EQ(nsvcd_pair_travel(a.checker, pair, low, NULL, moved), NSVCD_ERROR_ARGUMENT);
  const nsvcd_body_pair same = {FORE, FORE};
  CHECK_EQ(nsvcd_pair_travel(a.checker, same, low, high, moved), NSVCD_ERROR_PAIR);
  arm_close(&a);
}

// A post just out of reach comes within a clearance; and what allows contact allows none here.
static void a_clearance_is_kept_over_all_values(void) {
  const nsvcd_range_options wide = {.clearance = 0.2f};
  const double start[ARM_JOINTS] = {0, 0};
  const nsvcd_allowance anywhere = {0, start, 100};
  arm a;
  arm_open(&a, at(1.2f, 0, 0));
  CHECK_EQ(range_of(&a, UPPER, POST, NULL).meeting, NSVCD_MEETS_NEVER);
  CHECK_EQ(range_of(&a, UPPER, POST, &wide).meeting, NSVCD_MEETS_SOMETIMES);
  arm_close(&a);
  arm_open(&a, at(0.7f, 0, 0));
  nsvcd_checker *checker;
  a.scene.allowances = &anywhere;
  a.scene.allowance_count = 1;
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, nsvcd_checker_size(&a.scene), &checker),
           NSVCD_OK);
  CHECK_EQ(range_of(&a, UPPER, POST, NULL).meeting, NSVCD_MEETS_SOMETIMES);
  arm_close(&a);
}

static void a_range_is_refused_by_name(void) {
  const nsvcd_body_pair pair = {UPPER, POST};
  const nsvcd_body_pair same = {UPPER, UPPER};
  const nsvcd_range_options options = {.boxes = NSVCD_MAX_BOXES + 1};
  nsvcd_range_answer answer;
  arm a;
  arm_open(&a, at(0.7f, 0, 0));
  const size_t size = nsvcd_pair_range_size(a.checker, pair, NULL);
  void *memory = malloc(size);
  CHECK_EQ(nsvcd_pair_range_size(NULL, pair, NULL), 0);
  CHECK_EQ(nsvcd_pair_range(a.checker, same, NULL, memory, size, &answer), NSVCD_ERROR_PAIR);
  CHECK_EQ(nsvcd_pair_range(a.checker, pair, &options, memory, size, &answer), NSVCD_ERROR_COUNT);
  CHECK_EQ(nsvcd_pair_range(a.checker, pair, NULL, memory, size - 1, &answer),
           NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_pair_range(a.checker, pair, NULL, memory, size, NULL), NSVCD_ERROR_ARGUMENT);
  free(memory);
  arm_close(&a);
}

void promises_ranges(void) {
  RUN(parts_meet_never_sometimes_or_always);
  RUN(joints_of_a_box_move_points_no_farther);
  RUN(a_clearance_is_kept_over_all_values);
  RUN(a_range_is_refused_by_name);
}

CHECK_ALONE(promises_ranges)
