// What src/interface/configurations.h promises, a test each: of a robot in one configuration, what is
// near, a way out, who can meet whom, and a part that changes hands.
#include "arm.h"

void promises_postures(void);

// The arm lies along x, and the post beside its tip, 3 cm from it.
static void a_gap_is_bracketed_and_grows_as_its_slope_says(void) {
  const double still[ARM_JOINTS] = {0, 0}, on[ARM_JOINTS] = {0, -0.01};
  nsvcd_proximity gaps[ARM_PAIRS], later[ARM_PAIRS];
  size_t count = 0;
  arm a;
  arm_open(&a, at(2.1f, 0.13f, 0));
  CHECK_EQ(nsvcd_proximities(a.checker, still, NULL, gaps, ARM_PAIRS, &count), NSVCD_OK);
  CHECK(count == 1 && gaps[0].pair == FORE && gaps[0].verdict == NSVCD_FREE);
  CHECK(gaps[0].distance.low <= 0.03f + 1e-6f && gaps[0].distance.high >= 0.03f - 1e-6f);
  CHECK_LE(gaps[0].distance.high - gaps[0].distance.low, 2.2e-5);
  CHECK(gaps[0].slope[1] < -0.9 && gaps[0].slope[0] < -1.9);  // levers of 1 and 2 m
  CHECK_EQ(nsvcd_proximities(a.checker, on, NULL, later, ARM_PAIRS, &count), NSVCD_OK);
  CHECK_NEAR(later[0].distance.low, (double)gaps[0].distance.low - 0.01 * gaps[0].slope[1], 1e-3);
  arm_close(&a);
}

static void a_lift_by_the_depth_parts_two_links(void) {
  const double still[ARM_JOINTS] = {0, 0};
  nsvcd_proximity gaps[ARM_PAIRS];
  size_t count = 0;
  arm a;
  arm_open(&a, at(2, 0.095f, 0));  // 5 mm deep
  CHECK_EQ(nsvcd_proximities(a.checker, still, NULL, gaps, ARM_PAIRS, &count), NSVCD_OK);
  CHECK(count == 1 && gaps[0].verdict == NSVCD_HIT);
  CHECK_NEAR(gaps[0].depth, 0.005, 2e-4);
  a.parts[POST].pose.position[1] += 1.001f * gaps[0].depth;
  CHECK_NEAR(gaps[0].contact.normal[1], -1, 1e-5);
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, nsvcd_checker_size(&a.scene), &a.checker),
           NSVCD_OK);
  CHECK_EQ(verdict_at(&a, still), NSVCD_FREE);
  arm_close(&a);
}

static void an_escape_is_free_and_not_far(void) {
  const double still[ARM_JOINTS] = {0, 0};
  const nsvcd_nearest_free_options options = {.clearance = 0.01f, .farthest = 0.2};
  double out[ARM_JOINTS];
  int is_found = 0;
  arm a;
  arm_open(&a, at(2, 0.095f, 0));
  CHECK_EQ(verdict_at(&a, still), NSVCD_HIT);
  CHECK_EQ(nsvcd_nearest_free(a.checker, still, &options, out, &is_found), NSVCD_OK);
  CHECK(is_found);
  const nsvcd_joint_motion there = {.degree = 1, .points = out};
  CHECK_EQ(check_of(&a, &there, 0.01f).verdict, NSVCD_FREE);
  CHECK_LE(hypot(out[0], out[1]), 0.2);
  arm_close(&a);
}

// Of the arm's two links, which a joint parts, nothing is asked; of the post and each of them, all.
static void no_pair_that_can_meet_is_missing(void) {
  nsvcd_body_pair pairs[3];
  nsvcd_pair_counts counts = {0, 0, 0};
  arm a;
  arm_open(&a, at(2, 0.3f, 0));
  CHECK_EQ(nsvcd_find_pairs(a.checker, 0, 1, pairs, 3, &counts), NSVCD_OK);
  CHECK(counts.asked == 2 && counts.adjacent == 1 && counts.touching == 0);
  for (int i = 0; i < 2; i++) CHECK(pairs[i].a == POST || pairs[i].b == POST);
  CHECK((pairs[2].a ^ pairs[2].b) == (UPPER ^ FORE));
  CHECK_EQ(nsvcd_find_pairs(a.checker, 0, 1, pairs, 1, &counts), NSVCD_ERROR_WORKSPACE);
  arm_close(&a);
}

// The hand takes the post along: it stays where it is as it is taken, and moves with the link then.
static void a_part_that_is_handed_over_stays_where_it_is(void) {
  const double here[ARM_JOINTS] = {0.5, 1}, there[ARM_JOINTS] = {0.5, 2};
  nsvcd_pose before[ARM_PARTS], after[ARM_PARTS], later[ARM_PARTS];
  nsvcd_part taken;
  arm a;
  arm_open(&a, at(1, 1.5f, 0.2f));
  nsvcd_forward_kinematics(a.checker, here, before);
  CHECK_EQ(nsvcd_reparent(a.checker, here, POST, 2, &taken), NSVCD_OK);
  CHECK_EQ(taken.link, 2);
  a.parts[POST] = taken;
  a.scene.pair_count = 1;  // the upper arm and what is held
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, nsvcd_checker_size(&a.scene), &a.checker),
           NSVCD_OK);
  nsvcd_forward_kinematics(a.checker, here, after);
  nsvcd_forward_kinematics(a.checker, there, later);
  for (int k = 0; k < 3; k++) CHECK_NEAR(after[POST].position[k], before[POST].position[k], 1e-6);
  CHECK(fabsf(later[POST].position[0] - after[POST].position[0]) > 0.1f);
  CHECK_EQ(nsvcd_reparent(a.checker, here, 3, 2, &taken), NSVCD_ERROR_LINK);
  arm_close(&a);
}

void promises_postures(void) {
  RUN(a_gap_is_bracketed_and_grows_as_its_slope_says);
  RUN(a_lift_by_the_depth_parts_two_links);
  RUN(an_escape_is_free_and_not_far);
  RUN(no_pair_that_can_meet_is_missing);
  RUN(a_part_that_is_handed_over_stays_where_it_is);
}

CHECK_ALONE(promises_postures)
