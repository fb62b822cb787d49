// What src/interface/robots.h promises, a test each: of a motion of joints what is said holds as
// the joints move, at all times.
#include "arm.h"
#include "../../examples/verify/nsvcd_verify_robot.h"

void promises_robots(void);

// The forearm turns past a post on a circle: its ends, and the chord between them, are clear.
static void what_a_joint_sweeps_between_samples_is_seen(void) {
  const double turn[4] = {0, -1, 0, 1};
  const nsvcd_joint_motion motion = line_of(turn);
  arm a;
  arm_open(&a, at(2.2f, 0, 0));  // the tip reaches 1.05 m, the post's face is 1.05 m off: it is hit
  CHECK_EQ(verdict_at(&a, turn), NSVCD_FREE);
  CHECK_EQ(verdict_at(&a, turn + 2), NSVCD_FREE);
  const nsvcd_check_answer hit = check_of(&a, &motion, 0);
  CHECK(hit.verdict == NSVCD_HIT && hit.pair == FORE && hit.piece == 0);
  arm_close(&a);

  arm_open(&a, at(2.21f, 0, 0));  // its corners pass at 8.8 mm
  CHECK_EQ(check_of(&a, &motion, 0).verdict, NSVCD_FREE);
  CHECK_EQ(check_of(&a, &motion, 0.008f).verdict, NSVCD_FREE);
  CHECK_EQ(check_of(&a, &motion, 0.0101f).verdict, NSVCD_HIT);
  arm_close(&a);
}

static void a_hit_is_one_in_the_configuration_that_is_named(void) {
  const double turn[4] = {0, -1, 0.5, 1};
  const nsvcd_joint_motion motion = line_of(turn);
  double joints[ARM_JOINTS];
  nsvcd_pose poses[ARM_PARTS];
  arm a;
  arm_open(&a, at(2, 0.3f, 0));
  const nsvcd_check_answer hit = check_of(&a, &motion, 0);
  CHECK_EQ(hit.verdict, NSVCD_HIT);
  nsvcd_motion_at(&motion, ARM_JOINTS, (double)hit.piece + hit.fraction, joints);
  nsvcd_forward_kinematics(a.checker, joints, poses);
  const nsvcd_body_pair pair = a.pairs[hit.pair];
  nsvcd_question question = question_about(a.parts[pair.a].body, &poses[pair.a], 1, a.post);
  question.b.poses = &poses[pair.b];
  question.b.count = 1;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  arm_close(&a);
}

// With both joints at a right angle the forearm points along -x, 1.1 m up in y.
static void links_are_where_the_joints_place_them(void) {
  const double corner[ARM_JOINTS] = {acos(0.0), acos(0.0)};
  nsvcd_pose poses[ARM_PARTS];
  arm a;
  arm_open(&a, at(5, 0, 0));
  nsvcd_forward_kinematics(a.checker, corner, poses);
  CHECK_NEAR(poses[UPPER].position[0], 0, 1e-6);
  CHECK_NEAR(poses[UPPER].position[1], 0.55, 1e-6);
  CHECK_NEAR(poses[FORE].position[0], -0.55, 1e-6);
  CHECK_NEAR(poses[FORE].position[1], 1.1, 1e-6);
  CHECK_NEAR(fabs((double)poses[FORE].rotation[2]), 1, 1e-6);
  CHECK_EQ(poses[POST].position[0], 5);
  arm_close(&a);
}

// The forearm passes the post at 0.1 m: too near if that pair is to keep more, whatever the other is.
static void each_pair_keeps_its_own_clearance(void) {
  static const double joints[ARM_JOINTS] = {0, 0};
  static const float wanted[4][ARM_PAIRS] = {{0, 0}, {0.2f, 0}, {0, 0.09f}, {0, 0.11f}};
  for (int k = 0; k < 4; k++) {
    arm a;
    arm_open(&a, at(1.6f, 0.2f, 0));
    a.scene.clearances = wanted[k];
    const size_t size = nsvcd_checker_size(&a.scene);
    CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, size, &a.checker), NSVCD_OK);
    CHECK_EQ(verdict_at(&a, joints), k == 3 ? NSVCD_HIT : NSVCD_FREE);
    arm_close(&a);
  }
}

// Two pieces of degree 2, with times: a parabola, then a line.
static void a_motion_is_bezier_in_time(void) {
  const double points[5] = {0, 0, 1, 2, 3};
  const double times[3] = {0, 2, 3};
  const nsvcd_joint_motion motion = {2, 2, points, times};
  static const double expected[5][2] = {{-1, 0}, {0, 0}, {1, 0.25}, {2, 1}, {2.5, 2}};
  for (int i = 0; i < 5; i++) {
    double out;
    nsvcd_motion_at(&motion, 1, expected[i][0], &out);
    CHECK_NEAR(out, expected[i][1], 1e-12);
  }
}

static void a_joint_that_leaves_its_limits_is_told(void) {
  const double within[4] = {0, 0, 1, 2.9}, beyond[4] = {0, 0, 1, 3.1};
  nsvcd_joint_motion motion = line_of(within);
  arm a;
  arm_open(&a, at(5, 0, 0));
  CHECK_EQ(check_of(&a, &motion, 0).joint, NSVCD_NONE);
  motion.points = beyond;
  CHECK_EQ(check_of(&a, &motion, 0).joint, 1);
  arm_close(&a);
}

// What is asked is about lengths between parts: a robot 100 km away is told about as well.
static void it_does_not_matter_how_far_away_a_robot_stands(void) {
  const double turn[4] = {0, -1, 0, 1};
  const nsvcd_joint_motion motion = line_of(turn);
  for (int k = 0; k < 2; k++) {
    const float offset = k ? 0.01f : 0;
    arm a;
    arm_open(&a, at(0, 0, 0));
    a.joints[0].origin = at(131072, 65536, 0);
    a.parts[POST].pose = at(131072 + 2.203125f, 65536, 0);  // exact in float
    a.joints[1].origin = at(1.1f - offset, 0, 0);
    CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, nsvcd_checker_size(&a.scene), &a.checker),
             NSVCD_OK);
    CHECK_EQ(check_of(&a, &motion, 0.007f).verdict, k ? NSVCD_FREE : NSVCD_HIT);
    arm_close(&a);
  }
}

static int at_once(void *user) {
  return ++*(int *)user > 0;
}
static void a_check_can_be_stopped_and_refuses_by_name(void) {
  const double turn[4] = {0, -1, 0, 1};
  const nsvcd_joint_motion motion = line_of(turn);
  int asked = 0;
  nsvcd_check_options options = {.stop = at_once, .user = &asked};
  nsvcd_check_answer answer;
  arm a;
  arm_open(&a, at(2, 0, 0));
  CHECK_EQ(nsvcd_check(a.checker, &motion, &options, &answer), NSVCD_OK);
  CHECK_EQ(answer.verdict, NSVCD_UNDECIDED);
  CHECK_EQ(answer.why, NSVCD_WHY_WORK);
  CHECK_EQ(asked, 1);
  options.clearance = -1;
  CHECK_EQ(nsvcd_check(a.checker, &motion, &options, &answer), NSVCD_ERROR_CLEARANCE);
  a.joints[1].low = 4;
  CHECK_EQ(nsvcd_checker_size(&a.scene), 0);
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, 1 << 20, &a.checker), NSVCD_ERROR_LIMITS);
  a.joints[1].low = -3;
  a.parts[FORE].link = 3;
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, 1 << 20, &a.checker), NSVCD_ERROR_LINK);
  a.parts[FORE].link = 2;
  a.pairs[1].b = 7;
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, 1 << 20, &a.checker), NSVCD_ERROR_PAIR);
  arm_close(&a);
}

// The forearm and the post, proven to whoever has the joints, the meshes and examples/verify.
static void a_certificate_of_a_pair_is_accepted_by_the_checker(void) {
  enum { ROOM = 16384 };
  static uint8_t bytes[ROOM];
  static double room[NSVCD_VERIFY_WORKSPACE_BYTES(16) / sizeof(double)];
  const double turn[4] = {0, -1, 0, 1}, times[2] = {0, 1};
  const nsvcd_joint_motion motion = {1, 1, turn, times};
  nsvcd_mesh meshes[2] = {box_mesh(1, 0.1f, 0.1f), box_mesh(0.1f, 0.1f, 2)};
  const nsvcd_tree *trees[2];
  void *memory[2], *views[2];
  nsvcd_verify_mesh checked[2];
  arm a;
  arm_open(&a, at(2.21f, 0, 0));
  for (int k = 0; k < 2; k++) {
    const size_t size = nsvcd_tree_size(&meshes[k]);
    memory[k] = malloc(size);
    CHECK_EQ(nsvcd_tree_build(&meshes[k], memory[k], size, &trees[k]), NSVCD_OK);
    views[k] = malloc(NSVCD_VERIFY_MESH_BYTES(8, 12));
    CHECK(!nsvcd_verify_mesh_init(meshes[k].positions, 8, meshes[k].indices, 12, views[k],
                                  &checked[k]));
  }
  const size_t size = nsvcd_certify_pair_workspace_size(&motion, trees[0], trees[1]);
  void *workspace = malloc(size);
  nsvcd_certificate made;
  CHECK_EQ(nsvcd_certify_pair(a.checker, &motion, FORE, 0, trees[0], trees[1], NULL, workspace,
                              size, bytes, ROOM, &made),
           NSVCD_OK);
  CHECK_EQ(made.verdict, NSVCD_FREE);

  nsvcd_verify_joint joints[ARM_JOINTS];
  const nsvcd_verify_motion seen = {joints, ARM_JOINTS, 1, 1, turn, times};
  nsvcd_verify_part parts[2];
  nsvcd_verify_mover movers[2];
  nsvcd_verify_report report;
  for (int i = 0; i < ARM_JOINTS; i++) {
    joints[i] = (nsvcd_verify_joint){.parent = a.joints[i].parent, .axis = {0, 0, 1}};
    memcpy(joints[i].origin, &a.joints[i].origin, sizeof joints[i].origin);
  }
  CHECK(!nsvcd_verify_motion_check(&seen));
  for (int k = 0; k < 2; k++) {
    parts[k] = (nsvcd_verify_part){.motion = &seen, .link = a.parts[FORE + k].link};
    parts[k].base = nsvcd_verify_common(&seen, a.parts[FORE].link, a.parts[POST].link);
    memcpy(parts[k].pose, &a.parts[FORE + k].pose, sizeof parts[k].pose);
    CHECK(!nsvcd_verify_part_init(&checked[k], 1, &parts[k], &movers[k]));
  }
  CHECK(nsvcd_verify(&movers[0], &movers[1], 0, bytes, made.size, room, sizeof room, &report));
  CHECK_EQ(report.kind, NSVCD_VERIFY_FREE);
  for (int k = 0; k < 2; k++) {
    nsvcd_mesh_free(&meshes[k], NULL);
    free(memory[k]);
    free(views[k]);
  }
  free(workspace);
  arm_close(&a);
}

// The upper arm begins in the post. It may go out of it, and back to where it was; not on through it.
static void contact_is_allowed_near_a_configuration(void) {
  const double in[4] = {0.1, 0, 0.6, 0};
  const double through[4] = {0.1, 0, -0.6, 0};
  const nsvcd_joint_motion out = line_of(in);
  const nsvcd_joint_motion on = line_of(through);
  const nsvcd_allowance allowance = {0, in, 0.2};
  nsvcd_checker *checker;
  arm a;
  arm_open(&a, at(0.7f, 0, 0));
  CHECK_EQ(verdict_at(&a, in), NSVCD_HIT);
  free(a.memory);
  a.scene.allowances = &allowance;
  a.scene.allowance_count = 1;
  const size_t size = nsvcd_checker_size(&a.scene);
  a.memory = malloc(size);
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, size, &checker), NSVCD_OK);
  a.checker = checker;
  CHECK_EQ(verdict_at(&a, in), NSVCD_FREE);
  CHECK_EQ(check_of(&a, &out, 0).verdict, NSVCD_FREE);
  CHECK_EQ(check_of(&a, &on, 0).verdict, NSVCD_HIT);
  // 0.5 radians, of which it may go 0.2 m on the way back to where it may touch
  double time = 0;
  CHECK_EQ(nsvcd_allowed_until(a.checker, &allowance, &out, 0, &time), NSVCD_OK);
  CHECK(time > 0.2 && time < 0.9);
  arm_close(&a);
}

// Half a turn a second, into the post.
static void a_motion_is_free_until_it_is_not(void) {
  const double points[4] = {1.5, 0, -1.5, 0};
  const double times[2] = {10, 16};
  const nsvcd_joint_motion motion = {1, 1, points, times};
  const nsvcd_check_options options = {.to_time = 1e-5};
  nsvcd_check_answer answer;
  arm a;
  arm_open(&a, at(0.7f, 0, 0));
  CHECK_EQ(nsvcd_check(a.checker, &motion, &options, &answer), NSVCD_OK);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK(answer.free_until > 10 && answer.free_until < 13);
  CHECK_NEAR(10 + 6 * answer.fraction, answer.free_until, 2e-5);
  const double before[2] = {1.5 - 0.5 * (answer.free_until - 10), 0};
  const double after[2] = {before[0] - 1e-4, 0};
  CHECK(verdict_at(&a, before) != NSVCD_HIT);
  CHECK_EQ(verdict_at(&a, after), NSVCD_HIT);
  arm_close(&a);
}

// The arm passes a post bent, or it is straight by then and hits it.
static void robots_on_their_own_clocks_meet_when_they_do(void) {
  const double turn[2] = {-1.5, 1.5};
  const double bend[2] = {2.8, 0};
  const uint32_t joints[2] = {0, 1};
  const nsvcd_check_options options = {.to_time = 1e-3};
  arm a;
  arm_open(&a, at(2, 0, 0));
  for (int n = 0; n < 2; n++) {
    // bent while it passes, straight after that; or straight before
    const nsvcd_partial_motion motions[2] = {
        {{.pieces = 1, .degree = 1, .points = turn}, &joints[0], 1, n ? 5 : 0},
        {{.pieces = 1, .degree = 1, .points = bend}, &joints[1], 1, n ? 0 : 5}};
    const size_t size = nsvcd_merge_motions_size(motions, 2, ARM_JOINTS);
    void *memory = malloc(size);
    nsvcd_joint_motion merged;
    nsvcd_check_answer found;
    double q[ARM_JOINTS];
    CHECK_EQ(nsvcd_merge_motions(motions, 2, ARM_JOINTS, NULL, memory, size, &merged), NSVCD_OK);
    CHECK_EQ(merged.pieces, 3);
    nsvcd_motion_at(&merged, ARM_JOINTS, 3, q);
    CHECK(q[0] == (n ? -1.5 : 1.5) && q[1] == (n ? 0 : 2.8));
    CHECK_EQ(nsvcd_check(a.checker, &merged, &options, &found), NSVCD_OK);
    CHECK_EQ(found.verdict, n ? NSVCD_HIT : NSVCD_FREE);
    if (n) {
      CHECK(found.pair == FORE && found.piece == 2 && found.free_until > 5.4);
      nsvcd_motion_at(&merged, ARM_JOINTS, found.free_until - 1e-3, q);
      CHECK_EQ(verdict_at(&a, q), NSVCD_FREE);
      nsvcd_motion_at(&merged, ARM_JOINTS, found.free_until + 2e-3, q);
      CHECK_EQ(verdict_at(&a, q), NSVCD_HIT);
    }
    free(memory);
  }
  arm_close(&a);
}

// The upper arm's x points within 0.5 of the world's x, no farther: also where a motion goes beyond
// that only between its ends.
static void an_axis_stays_in_its_cone(void) {
  const double in[4] = {-0.49, 2, 0.49, -2};
  const double out[4] = {0, 0, 0.6, 0};
  const double bent[6] = {0, 0, 1.01, 0, 0, 0};
  const nsvcd_joint_motion inside = line_of(in);
  const nsvcd_joint_motion leaves = line_of(out);
  const nsvcd_joint_motion turns_back = {.pieces = 1, .degree = 2, .points = bent};
  const nsvcd_cone cone = {UPPER, {1, 0, 0}, {2, 0, 0}, 0.5};
  arm a;
  arm_open(&a, at(0, 5, 0));
  free(a.memory);
  a.scene.cones = &cone;
  a.scene.cone_count = 1;
  const size_t size = nsvcd_checker_size(&a.scene);
  a.memory = malloc(size);
  CHECK_EQ(nsvcd_checker_open(&a.scene, a.memory, size, &a.checker), NSVCD_OK);
  CHECK_EQ(check_of(&a, &inside, 0).verdict, NSVCD_FREE);
  CHECK_EQ(check_of(&a, &inside, 0).cone, NSVCD_NONE);
  const nsvcd_check_answer answer = check_of(&a, &leaves, 0);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_EQ(answer.cone, 0);
  CHECK_EQ(answer.pair, NSVCD_NONE);
  CHECK_GE(0.6 * answer.fraction, 0.5);
  CHECK_EQ(check_of(&a, &turns_back, 0).cone, 0);
  CHECK_EQ(verdict_at(&a, out + 2), NSVCD_HIT);
  arm_close(&a);
}

void promises_robots(void) {
  RUN(an_axis_stays_in_its_cone);
  RUN(robots_on_their_own_clocks_meet_when_they_do);
  RUN(contact_is_allowed_near_a_configuration);
  RUN(a_motion_is_free_until_it_is_not);
  RUN(what_a_joint_sweeps_between_samples_is_seen);
  RUN(a_hit_is_one_in_the_configuration_that_is_named);
  RUN(links_are_where_the_joints_place_them);
  RUN(each_pair_keeps_its_own_clearance);
  RUN(a_motion_is_bezier_in_time);
  RUN(a_joint_that_leaves_its_limits_is_told);
  RUN(it_does_not_matter_how_far_away_a_robot_stands);
  RUN(a_check_can_be_stopped_and_refuses_by_name);
  RUN(a_certificate_of_a_pair_is_accepted_by_the_checker);
}

CHECK_ALONE(promises_robots)
