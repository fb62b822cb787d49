// Robots: what a part leaves its sweep by, against motions of the joints sampled densely, and
// verdicts of motions, against distances in double at many times. Links are placed here anew, by
// matrices.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_certify.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "check.h"
#include "route_scene.h"

void test_robot(void);

// A sample of a checker.
static oracle_pose pose_of_frame(const nsvcd__dpose *frame) {
  const oracle_pose out = {
      {frame->position.x, frame->position.y, frame->position.z},
      {frame->rotation.x, frame->rotation.y, frame->rotation.z, frame->rotation.w}};
  return out;
}

// The farthest of some vertices of a part from where the sweep has it at a share u of a step, as
// samples a and b say.
static double robot_off(const robot *r, size_t part, const placed *at, const oracle_pose *a,
                        const oracle_pose *b, double u) {
  const robot_shape *shape = &robot_shapes()[r->shape[part]];
  const double scale = scale_of_part(&r->parts[part]);
  const oracle_pose swept = oracle_pose_between(a, b, u);
  double most = 0;
  for (size_t i = 0; i < shape->count; i += 1 + shape->count / 24) {
    double is[3], was[3], x[3], off[3];
    placed_point(at, scale, &shape->points[3 * i], is);
    for (int k = 0; k < 3; k++) x[k] = scale * shape->points[3 * i + (size_t)k];
    oracle_transform(&swept, x, was);
    oracle_sub(is, was, off);
    most = fmax(most, oracle_length(off));
  }
  return most;
}

// A ball on a random robot passes another one, that rests or is on another link, at a distance that
// is the clearance to within 1 mm or 1 um, which is known from their centres at many times. What
// comes nearer is never free, what does not is no hit.
static double robot_balls_apart(const robot *r, const double *points, size_t degree, double s) {
  double q[NSVCD_MAX_JOINTS], off[3];
  joints_of_piece(points, degree, r->scene.joint_count, s, q);
  const placed a = placed_part(&r->scene, 0, q);
  const placed b = placed_part(&r->scene, 1, q);
  oracle_sub(a.p, b.p, off);
  return oracle_length(off);
}
static void robot_grazes(void) {
  enum { LOOKS = 400 };
  static robot r;
  shapes_rng rng = {76};
  const nsvcd_body *ball = NULL;
  size_t free_count = 0;
  size_t hits = 0;
  size_t undecided = 0;
  CHECK_EQ(nsvcd_encode_sphere(0.05f, NULL, &ball), NSVCD_OK);
  for (int trial = 0; trial < 3000; trial++) {
    double points[NSVCD_MAX_DEGREE + 1][NSVCD_MAX_JOINTS];
    double *flat = &points[0][0];
    double at[NSVCD_MAX_JOINTS], way[3], off[3], here[3];
    nsvcd_check_answer answer;
    nsvcd_check_options options;
    robot_random(&r, &rng);
    const size_t joints = r.scene.joint_count;
    const size_t degree = 1 + (size_t)shapes_pick(&rng, NSVCD_MAX_DEGREE);
    const double size = pow(10, shapes_uniform(&rng, -1.5, -0.3));
    for (size_t j = 0; j < joints; j++) {
      const double from = shapes_uniform(&rng, -1, 1);
      for (size_t i = 0; i <= degree; i++)
        flat[i * joints + j] = from + size * (shapes_normal(&rng) + (double)i / (double)degree);
    }
    memset(&options, 0, sizeof options);
    memset(&answer, 0, sizeof answer);
    options.clearance = shapes_pick(&rng, 2) ? 0 : 0.01f;
    const double reach = 0.1 + (double)options.clearance;
    const double near = shapes_pick(&rng, 2) ? 1e-3 : 3e-5;
    for (size_t n = 0; n < 2; n++) {
      r.parts[n].body = ball;
      r.parts[n].scale = 1;
      if (n) r.parts[n].pose = robot_pose(&rng, 0);
      r.parts[n].link = n ? (uint32_t)shapes_pick(&rng, (int)joints) : (uint32_t)joints;
    }
    r.scene.part_count = 2;
    r.scene.pair_count = 1;
    r.pairs[0].a = (uint32_t)shapes_pick(&rng, 2);
    r.pairs[0].b = 1 - r.pairs[0].a;
    // where the other one is in its link, so that they pass at some time
    const double when = shapes_uniform(&rng, 0, 0.999);
    joints_of_piece(flat, degree, joints, when, at);
    const placed moving = placed_part(&r.scene, 0, at);
    const placed link = placed_link(&r.scene, r.parts[1].link, at);
    // across its way as the other link sees it, so that they are nearest then
    double there[NSVCD_MAX_JOINTS], went[3];
    joints_of_piece(flat, degree, joints, when + 1e-6, there);
    const placed later = placed_part(&r.scene, 0, there);
    const placed link_later = placed_link(&r.scene, r.parts[1].link, there);
    oracle_sub(moving.p, link.p, off);
    oracle_rotate_back(link.m, off, here);
    oracle_sub(later.p, link_later.p, off);
    oracle_rotate_back(link_later.m, off, went);
    oracle_sub(went, here, off);
    oracle_rotate(link.m, off, went);
    shapes_direction(&rng, way);
    const double along = oracle_dot(way, went) / fmax(oracle_dot(went, went), 1e-30);
    for (int k = 0; k < 3; k++) way[k] -= along * went[k];
    const double length = fmax(oracle_length(way), 1e-6);
    for (int k = 0; k < 3; k++) way[k] /= length;
    for (int k = 0; k < 3; k++)
      off[k] = moving.p[k] + (reach + near * shapes_uniform(&rng, -1, 1)) * way[k] - link.p[k];
    oracle_rotate_back(link.m, off, here);
    for (int k = 0; k < 3; k++) r.parts[1].pose.position[k] = (float)here[k];
    // how near they come: the least of many times, and about it
    double least = DBL_MAX;
    double best = 0;
    for (int k = 0; k <= LOOKS; k++) {
      const double apart = robot_balls_apart(&r, flat, degree, k / (double)LOOKS);
      if (apart < least) best = k / (double)LOOKS;
      least = fmin(least, apart);
    }
    double low = fmax(best - 1.0 / LOOKS, 0);
    double high = fmin(best + 1.0 / LOOKS, 1);
    for (int k = 0; k < 60; k++) {
      const double u = low + (high - low) / 3;
      const double v = high - (high - low) / 3;
      const double at_u = robot_balls_apart(&r, flat, degree, u);
      const double at_v = robot_balls_apart(&r, flat, degree, v);
      low = at_u < at_v ? low : u;
      high = at_u < at_v ? v : high;
      least = fmin(least, fmin(at_u, at_v));
    }
    robot_open(&r);
    const nsvcd_joint_motion motion = {1, degree, flat, NULL};
    CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
    if (least < reach - 1e-6) CHECK(answer.verdict != NSVCD_FREE);
    if (least > reach + 1e-6) CHECK(answer.verdict != NSVCD_HIT);
    if (answer.verdict == NSVCD_HIT)
      CHECK_LE(robot_balls_apart(&r, flat, degree, answer.fraction), reach + 2e-6);
    // a doubt is about what is nearer than two parts may stray at the finest
    if (answer.verdict == NSVCD_UNDECIDED) CHECK_NEAR(least, reach, 1e-4);
    free_count += answer.verdict == NSVCD_FREE;
    hits += answer.verdict == NSVCD_HIT;
    undecided += answer.verdict == NSVCD_UNDECIDED;
    free(r.memory);
  }
  printf("  balls that pass: free %zu, hit %zu, undecided %zu\n", free_count, hits, undecided);
  CHECK_GE(free_count, 300);
  CHECK_GE(hits, 1000);
  CHECK_LE(undecided, 600);
  nsvcd_body_free(ball, NULL);
}

// A ball on an arm swings past a wall, and is turned back as it goes: what is said follows from the
// arm's length. The boxes about its samples stay farther from the wall than it does.
static void robot_swings_past_a_wall(void) {
  static robot r;
  shapes_rng rng = {78};
  const nsvcd_body *ball = NULL;
  size_t free_count = 0;
  size_t hits = 0;
  CHECK_EQ(nsvcd_encode_sphere(0.05f, NULL, &ball), NSVCD_OK);
  for (int trial = 0; trial < 600; trial++) {
    const double reach = shapes_uniform(&rng, 0.3, 1);
    const double turn = shapes_uniform(&rng, 0.05, 1);
    const double gap = (trial % 2 ? 1 : -1) * pow(10, shapes_uniform(&rng, -3.7, -2.9));
    const double end = turn * shapes_uniform(&rng, 0.5, 1);
    const double points[2][2] = {{-turn, turn}, {end, -end}};
    const nsvcd_joint_motion motion = {1, 1, &points[0][0], NULL};
    nsvcd_check_options options;
    nsvcd_check_answer answer;
    memset(&options, 0, sizeof options);
    options.clearance = shapes_pick(&rng, 2) ? 0 : 0.01f;
    robot_bare(&r, NSVCD_JOINT_REVOLUTE, 2, 2, 3);
    for (int n = 0; n < 2; n++) r.joints[n].axis[2] = 1;
    r.joints[1].origin.position[0] = (float)reach;
    r.parts[0].body = ball;
    r.parts[0].link = 2;
    r.parts[1].body = robot_shapes()[0].body;  // a box of 0.1 m
    r.parts[1].pose.position[0] = (float)(reach + 0.05 + 0.05 + (double)options.clearance + gap);
    robot_open(&r);
    CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
    CHECK(answer.verdict != (gap > 0 ? NSVCD_HIT : NSVCD_FREE));
    free_count += answer.verdict == NSVCD_FREE;
    hits += answer.verdict == NSVCD_HIT;
    free(r.memory);
  }
  nsvcd_body_free(ball, NULL);
  CHECK_GE(free_count, 250);
  CHECK_GE(hits, 250);
}

// A thousand turns past a wall, in one piece: as many steps as it takes.
static void robot_turns_for_long(void) {
  static robot r;
  const double points[2] = {1, 6000};
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  for (int hits = 0; hits < 2; hits++) {
    nsvcd_check_answer answer;
    robot_bare(&r, NSVCD_JOINT_CONTINUOUS, 1, 2, 0);
    r.joints[0].axis[2] = 1;
    for (uint32_t n = 0; n < 2; n++) {
      r.parts[n].body = robot_shapes()[0].body;
      r.parts[n].link = 1 - n;
      r.parts[n].pose.position[0] = n ? (hits ? 0.6f : 0.65f) : 0.5f;
    }
    robot_open(&r);
    CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_OK);
    CHECK_EQ(answer.verdict, hits ? NSVCD_HIT : NSVCD_FREE);
    free(r.memory);
  }
}

// What is said of configurations, edges and curves of an arm among boxes is so, at many times.
static void robot_verdicts_are_right(void) {
  static robot r;
  shapes_rng rng = {72};
  size_t free_count = 0;
  size_t hits = 0;
  size_t undecided = 0;
  size_t sweeps = 0;
  size_t still_hits = 0;
  for (int trial = 0; trial < 40; trial++) {
    robot_arm(&r, &rng, 12);
    for (int n = 0; n < 10; n++) {
      double points[2 * NSVCD_MAX_DEGREE + 1][6];
      nsvcd_check_answer answer;
      nsvcd_check_options options;
      memset(&options, 0, sizeof options);
      memset(&answer, 0, sizeof answer);
      options.clearance = shapes_pick(&rng, 2) ? 0 : 0.005f;
      const size_t degree = 1 + (size_t)shapes_pick(&rng, 5);
      nsvcd_joint_motion motion = {(size_t)shapes_pick(&rng, 3), degree, NULL, NULL};
      double *flat = &points[0][0];
      const size_t count = motion.pieces * degree + 1;
      for (size_t j = 0; j < 6; j++) {
        double at = shapes_uniform(&rng, -2, 2);
        for (size_t i = 0; i < count; i++) {
          flat[6 * i + j] = at;
          at += 0.8 / (double)degree * shapes_normal(&rng);
        }
      }
      motion.points = flat;
      CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
      sweeps += answer.sweeps;
      free_count += answer.verdict == NSVCD_FREE;
      hits += answer.verdict == NSVCD_HIT;
      undecided += answer.verdict == NSVCD_UNDECIDED;
      for (int k = 0; k <= 60 && answer.verdict == NSVCD_FREE; k++) {
        double q[6];
        const double s = k / 60.0 * (double)motion.pieces;
        const size_t piece = s < 1 ? 0 : motion.pieces - 1;
        const size_t order = motion.pieces ? degree : 0;
        joints_of_piece(flat + 6 * piece * degree, order, 6, s - (double)piece, q);
        for (size_t p = 0; p < r.scene.pair_count; p++)
          CHECK_LE((double)options.clearance, robot_apart(&r, &r.pairs[p], q, 0.1) + 1e-9);
      }
      if (answer.verdict == NSVCD_HIT) {
        double q[6];
        const size_t order = motion.pieces ? degree : 0;
        joints_of_piece(flat + 6 * answer.piece * degree, order, 6, answer.fraction, q);
        still_hits += motion.pieces == 0;
        CHECK_LE(robot_apart(&r, &r.pairs[answer.pair], q, 0.1), (double)options.clearance + 2e-5);
      }
    }
    free(r.memory);
  }
  printf("  free %zu, hit %zu, of which at rest %zu, undecided %zu; %.1f sweeps each\n", free_count,
         hits, still_hits, undecided, (double)sweeps / 400);
  CHECK_GE(still_hits, 10);
  CHECK_GE(free_count, 60);
  CHECK_GE(hits, 60);
  CHECK_LE(undecided, 4);
}

// Until when a motion is free that is not: nothing touches before, by points; a hit follows at once.
static void robot_is_free_until(void) {
  static robot r;
  shapes_rng rng = {75};
  size_t hits = 0;
  size_t late = 0;
  for (int trial = 0; trial < 12; trial++) {
    robot_arm(&r, &rng, 12);
    for (int n = 0; n < 10; n++) {
      double points[2 * NSVCD_MAX_DEGREE + 1][6];
      const double times[3] = {-1, shapes_uniform(&rng, 0, 1), 3};
      nsvcd_check_answer some, first;
      nsvcd_check_options options;
      memset(&options, 0, sizeof options);
      memset(&some, 0, sizeof some);
      memset(&first, 0, sizeof first);
      const size_t degree = 1 + (size_t)shapes_pick(&rng, 3);
      const size_t pieces = 1 + (size_t)shapes_pick(&rng, 2);
      const nsvcd_joint_motion motion = {pieces, degree, &points[0][0], times};
      for (size_t j = 0; j < 6; j++) {
        double at = shapes_uniform(&rng, -2, 2);
        for (size_t i = 0; i <= pieces * degree; i++) {
          points[i][j] = at;
          at += 0.8 / (double)degree * shapes_normal(&rng);
        }
      }
      CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &some), NSVCD_OK);
      options.to_time = 1e-4;
      CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &first), NSVCD_OK);
      CHECK_EQ(first.verdict, some.verdict);
      CHECK_LE(some.free_until, first.free_until);
      CHECK_LE(first.free_until, times[pieces]);
      if (first.verdict == NSVCD_FREE) CHECK_EQ(first.free_until, times[pieces]);
      for (int k = 0; k < 100 && first.free_until > times[0]; k++) {
        double q[6];
        const double t = times[0] + (first.free_until - times[0]) * k / 100;
        const size_t piece = pieces > 1 && t >= times[1];
        const double share = (t - times[piece]) / (times[piece + 1] - times[piece]);
        joints_of_piece(points[piece * degree], degree, 6, share, q);
        for (size_t p = 0; p < r.scene.pair_count; p++)
          CHECK_LE(1e-9, robot_apart(&r, &r.pairs[p], q, 0.1));
      }
      if (first.verdict != NSVCD_HIT) continue;
      double q[6];
      const double *at = times + first.piece;
      const double time = at[0] + first.fraction * (at[1] - at[0]);
      joints_of_piece(points[first.piece * degree], degree, 6, first.fraction, q);
      CHECK_LE(robot_apart(&r, &r.pairs[first.pair], q, 0.1), 2e-5);
      CHECK_LE(first.free_until, time);
      hits++;
      late += time - first.free_until > 1.0001e-4;
    }
    free(r.memory);
  }
  CHECK_GE(hits, 40);
  CHECK_EQ(late, 0);
}

// Poses are those of the matrices, to float's last digits; limits are looked at between points, and
// reaching one by rounding is not leaving it; a configuration is a motion of no pieces.
static void robot_parts_are_where_joints_say(void) {
  static robot r;
  shapes_rng rng = {73};
  for (int trial = 0; trial < 200; trial++) {
    double q[NSVCD_MAX_JOINTS];
    nsvcd_pose poses[MOST_PARTS];
    robot_random(&r, &rng);
    robot_open(&r);
    for (size_t j = 0; j < r.scene.joint_count; j++) q[j] = shapes_uniform(&rng, -3, 3);
    nsvcd_forward_kinematics(r.checker, q, poses);
    for (size_t n = 0; n < r.scene.part_count; n++) {
      const placed at = placed_part(&r.scene, n, q);
      const oracle_pose pose = pose_widened(&poses[n]);
      CHECK_LE(robot_off(&r, n, &at, &pose, &pose, 0), 2e-6);
    }
    free(r.memory);
  }
}

static void robot_limits_are_kept(void) {
  static robot r;
  shapes_rng rng = {74};
  nsvcd_check_answer answer;
  memset(&answer, 0, sizeof answer);
  // joint 2 goes to its limit and back, and a little beyond it between its ends
  double points[3][6] = {{0}, {0}, {0}};
  const nsvcd_joint_motion motion = {1, 2, &points[0][0], NULL};
  const nsvcd_joint_motion still = {0, 0, &points[1][0], NULL};
  robot_arm(&r, &rng, 0);
  points[1][2] = 2 * 3.1;
  CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_OK);
  CHECK_EQ(answer.joint, NSVCD_NONE);
  points[1][2] *= 1 + 1e-6;
  CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_OK);
  CHECK_EQ(answer.joint, 2);
  points[1][2] = r.joints[2].high * (1 + 1e-12);
  CHECK_EQ(nsvcd_check(r.checker, &still, NULL, &answer), NSVCD_OK);
  CHECK_EQ(answer.joint, NSVCD_NONE);
  points[1][2] = -r.joints[2].high - 1e-3;
  CHECK_EQ(nsvcd_check(r.checker, &still, NULL, &answer), NSVCD_OK);
  CHECK_EQ(answer.joint, 2);
  // without limits there is nothing to leave
  r.joints[2].kind = NSVCD_JOINT_CONTINUOUS;
  CHECK_EQ(nsvcd_check(r.checker, &still, NULL, &answer), NSVCD_OK);
  CHECK_EQ(answer.joint, NSVCD_NONE);
  free(r.memory);
}

// What cannot be is refused, with a code, and the answer left as it was.
static void robot_refuses_bad_input(void) {
  static robot r;
  shapes_rng rng = {75};
  nsvcd_check_answer answer;
  nsvcd_check_options options;
  nsvcd_checker *checker = NULL;
  double points[2][6] = {{0}, {0}};
  nsvcd_joint_motion motion = {1, 1, &points[0][0], NULL};
  memset(&options, 0, sizeof options);
  memset(&answer, 0x33, sizeof answer);
  const nsvcd_check_answer before = answer;
  robot_arm(&r, &rng, 1);
  const size_t size = nsvcd_checker_size(&r.scene);
  const nsvcd_scene scene = r.scene;
#define REFUSED_SCENE(change, back, code)                                   \
  do {                                                                      \
    change;                                                                 \
    CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), code); \
    CHECK_EQ(nsvcd_checker_size(&r.scene), 0);                              \
    back;                                                                   \
    r.scene = scene;                                                        \
  } while (0)
  const nsvcd_joint joint = r.joints[3];
  const nsvcd_part part = r.parts[2];
  REFUSED_SCENE(r.joints[3].parent = 4, r.joints[3] = joint, NSVCD_ERROR_JOINT);
  REFUSED_SCENE(memset(r.joints[3].axis, 0, 12), r.joints[3] = joint, NSVCD_ERROR_AXIS);
  REFUSED_SCENE(r.joints[3].axis[1] = NAN, r.joints[3] = joint, NSVCD_ERROR_AXIS);
  REFUSED_SCENE(r.joints[3].low = 4, r.joints[3] = joint, NSVCD_ERROR_LIMITS);
  REFUSED_SCENE(r.joints[3].high = NAN, r.joints[3] = joint, NSVCD_ERROR_LIMITS);
  REFUSED_SCENE(r.joints[3].kind = (nsvcd_joint_kind)7, r.joints[3] = joint, NSVCD_ERROR_JOINT);
  REFUSED_SCENE(r.joints[3].origin.rotation[3] = 0, r.joints[3] = joint, NSVCD_ERROR_QUATERNION);
  REFUSED_SCENE(r.parts[2].pose.position[0] = NAN, r.parts[2] = part, NSVCD_ERROR_POSE);
  REFUSED_SCENE(r.parts[2].scale = -1, r.parts[2] = part, NSVCD_ERROR_SCALE);
  REFUSED_SCENE(r.parts[2].body = NULL, r.parts[2] = part, NSVCD_ERROR_ARGUMENT);
  const uint64_t text[2] = {0x7a7a7a7a7a7a7a7au, 0};
  const void *no_body = text;
  REFUSED_SCENE(r.parts[2].body = (const nsvcd_body *)no_body, r.parts[2] = part, NSVCD_ERROR_BODY);
  REFUSED_SCENE(r.joints[3].speed = -1, r.joints[3] = joint, NSVCD_ERROR_SPEED);
  REFUSED_SCENE(r.parts[2].link = 7, r.parts[2] = part, NSVCD_ERROR_LINK);
  REFUSED_SCENE(r.scene.joint_count = 0, (void)0, NSVCD_ERROR_COUNT);
  REFUSED_SCENE(r.scene.joint_count = NSVCD_MAX_JOINTS + 1, (void)0, NSVCD_ERROR_COUNT);
  REFUSED_SCENE(r.scene.joints = NULL, (void)0, NSVCD_ERROR_ARGUMENT);
  const nsvcd_body_pair pair = r.pairs[0];
  REFUSED_SCENE(r.pairs[0].b = r.pairs[0].a, r.pairs[0] = pair, NSVCD_ERROR_PAIR);
  REFUSED_SCENE(r.pairs[0].b = 99, r.pairs[0] = pair, NSVCD_ERROR_PAIR);
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size - 1, &checker), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_checker_open(&r.scene, NULL, size, &checker), NSVCD_ERROR_WORKSPACE);
  CHECK(checker == NULL);

#define REFUSED(change, back, code)                                     \
  do {                                                                  \
    change;                                                             \
    CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), code); \
    CHECK_EQ(memcmp(&answer, &before, sizeof answer), 0);               \
    back;                                                               \
  } while (0)
  REFUSED(points[1][5] = NAN, points[1][5] = 0, NSVCD_ERROR_VALUE);
  REFUSED(points[0][0] = HUGE_VAL, points[0][0] = 0, NSVCD_ERROR_VALUE);
  REFUSED(motion.degree = 0, motion.degree = 1, NSVCD_ERROR_DEGREE);
  REFUSED(motion.degree = NSVCD_MAX_DEGREE + 1, motion.degree = 1, NSVCD_ERROR_DEGREE);
  REFUSED(motion.points = NULL, motion.points = &points[0][0], NSVCD_ERROR_ARGUMENT);
  REFUSED(options.clearance = -1, options.clearance = 0, NSVCD_ERROR_CLEARANCE);
  REFUSED(options.clearance = NAN, options.clearance = 0, NSVCD_ERROR_CLEARANCE);
  REFUSED(options.finest = -1, options.finest = 0, NSVCD_ERROR_FINEST);
  CHECK_EQ(nsvcd_check(NULL, &motion, &options, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
  free(r.memory);
}

// -------------------------------------------------------------------------------------------------
// routes

// Routes of an arm among boxes: found, free at many times by distances in double, smooth and within
// the limits; the same again from the same seed; quicker as a guess than by search.
static void robot_routes_are_free(void) {
  static robot r;
  shapes_rng rng = {83};
  size_t routes = 0;
  size_t found = 0;
  size_t smooth = 0;
  size_t sought = 0;
  size_t guesses = 0;
  size_t led = 0;
  for (int trial = 0; trial < 30; trial++) {
    asked_route a;
    memset(&a, 0, sizeof a);
    a.options.clearance = trial % 2 ? 0 : 0.01f;
    a.options.seed = (uint64_t)trial;
    robot_arm(&r, &rng, 14);
    for (size_t j = 0; j < 6; j++) {
      r.joints[j].speed = shapes_uniform(&rng, 1, 3);
      r.joints[j].acceleration = shapes_uniform(&rng, 3, 10);
    }
    const int is_asked = robot_free_place(&r, &rng, a.options.clearance, a.start) &&
                         robot_free_place(&r, &rng, a.options.clearance, a.goals[0]);
    if (is_asked) {
      ask_route(&r, &a);
      routes++;
    }
    if (is_asked && a.answer.status == NSVCD_ROUTE_FOUND) {
      const nsvcd_joint_motion *m = &a.answer.motion;
      const double end = m->times[m->pieces];
      found++;
      smooth += a.answer.stops == 0;
      sought += a.answer.nodes > 3;
      CHECK_EQ(end, a.answer.duration);
      CHECK_GE(a.answer.duration, a.answer.unhindered * (1 - 1e-9));
      robot_motion_is_smooth(&r, m, a.start, a.goals[0]);
      for (int k = 0; k <= 300; k++) {
        double q[6];
        double told[6];
        joints_at_time(m, 6, end * k / 300, q);
        nsvcd_motion_at(m, 6, end * k / 300, told);
        for (int j = 0; j < 6; j++) CHECK_NEAR(told[j], q[j], 1e-12);
        for (size_t p = 0; p < r.scene.pair_count; p++)
          CHECK_LE((double)a.options.clearance, robot_apart(&r, &r.pairs[p], q, 0.1) + 1e-9);
      }
      // again: from the same seed, with a checker that remembers nothing
      asked_route again = a;
      again.memory = NULL;
      CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, nsvcd_checker_size(&r.scene), &r.checker),
               NSVCD_OK);
      ask_route(&r, &again);
      CHECK_EQ(again.answer.motion.pieces, m->pieces);
      CHECK_EQ(
          memcmp(again.answer.motion.points, m->points, (2 * m->pieces + 1) * 6 * sizeof(double)),
          0);
      // its control points as a guess, a little to the side of the motion: nearly always free
      again.problem.guess = m->points;
      again.problem.guess_count = 2 * m->pieces + 1;
      again.options.nodes = 1;
      ask_route(&r, &again);
      guesses += a.options.clearance <= 0;
      led += a.options.clearance <= 0 && again.answer.status == NSVCD_ROUTE_FOUND;
      // shortcuts add corners, more than there are nodes
      again.options.shortcuts = 400;
      again.options.smoothings = NSVCD_NONE;
      ask_route(&r, &again);
      if (again.answer.status == NSVCD_ROUTE_FOUND)
        robot_motion_is_smooth(&r, &again.answer.motion, a.start, a.goals[0]);
      free(again.memory);
    }
    free(a.memory);
    free(r.memory);
  }
  printf("  %zu of %zu found, %zu by a search, %zu without stops\n", found, routes, sought, smooth);
  CHECK_GE(routes, 20);
  CHECK_GE(found + 2, routes);
  CHECK_GE(sought, 5);
  CHECK_GE(smooth + 2, found);
  printf("  %zu of %zu led by a guess\n", led, guesses);
  CHECK_GE(led, 3 * guesses / 4);
}

// What ends a search otherwise: a start or all goals that are not free, nodes, the caller. Of several
// goals one that is free is reached, by a joint without limits the shorter way round.
static void robot_routes_end(void) {
  static robot r;
  shapes_rng rng = {84};
  asked_route a;
  memset(&a, 0, sizeof a);
  robot_arm(&r, &rng, 0);
  // folded back on itself, somehow
  double folded[6];
  const nsvcd_joint_motion still = {0, 0, folded, NULL};
  nsvcd_check_answer found;
  memset(&found, 0, sizeof found);
  for (int n = 0; n < 100000 && found.verdict != NSVCD_HIT; n++) {
    for (int j = 0; j < 6; j++) folded[j] = shapes_uniform(&rng, -3, 3);
    CHECK_EQ(nsvcd_check(r.checker, &still, NULL, &found), NSVCD_OK);
  }
  CHECK_EQ(found.verdict, NSVCD_HIT);
  const double bent[6] = {2, 0.5, 0.3, 0, 0, 0};
  memcpy(a.goals[0], folded, sizeof folded);
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_GOAL);
  CHECK_EQ(a.answer.check.verdict, NSVCD_HIT);
  CHECK(a.answer.check.pair < r.scene.pair_count);
  // a goal out of limits; by rounding it is taken in
  memcpy(a.goals[0], bent, sizeof bent);
  a.goals[0][5] = 3.2;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_GOAL);
  CHECK_EQ(a.answer.check.joint, 5);
  a.goals[0][5] = 3.1 + 1e-10;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
  CHECK_EQ(a.answer.motion.points[12 * a.answer.motion.pieces + 5], 3.1);
  memcpy(a.start, folded, sizeof folded);
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_START);
  memset(a.start, 0, sizeof a.start);
  // to where it is
  memset(a.goals[0], 0, sizeof a.goals[0]);
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
  CHECK_EQ(a.answer.motion.pieces, 0);
  CHECK_EQ(a.answer.duration, 0);
  double there[6];
  nsvcd_motion_at(&a.answer.motion, 6, 1, there);
  CHECK_EQ(memcmp(there, a.start, sizeof there), 0);
  // the second of two goals
  memcpy(a.goals[0], folded, sizeof folded);
  memcpy(a.goals[1], bent, sizeof bent);
  a.problem.goal_count = 2;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
  CHECK_EQ(a.answer.goal, 1);
  a.problem.goal_count = 1;
  // a turn of 6 is one of 0.28 the other way
  memcpy(a.goals[0], bent, sizeof bent);
  a.start[0] = -3;
  a.goals[0][0] = 3;
  r.joints[0].kind = NSVCD_JOINT_CONTINUOUS;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
  CHECK_NEAR(a.answer.motion.points[12 * a.answer.motion.pieces], 3 - 2 * SHAPES_PI, 1e-12);
  r.joints[0].kind = NSVCD_JOINT_REVOLUTE;
  // stopped
  int left = 2;
  a.problem.stop = robot_stop;
  a.problem.user = &left;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_STOPPED);
  CHECK_EQ(a.answer.checks, 2);
  // once there is a way it is not given up
  left = 3;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
  a.problem.stop = NULL;
  free(a.memory);
  free(r.memory);
  // a slide through a slab: no way round it
  static robot slide;
  memset(&a, 0, sizeof a);
  robot_bare(&slide, NSVCD_JOINT_PRISMATIC, 1, 2, 1);
  slide.joints[0].axis[2] = 1;
  for (uint32_t n = 0; n < 2; n++) {
    slide.parts[n].body = robot_shapes()[n ? 2 : 0].body;
    slide.parts[n].link = 1 - n;
  }
  robot_open(&slide);
  a.start[0] = -0.5;
  a.goals[0][0] = 0.5;
  a.options.nodes = 40;
  ask_route(&slide, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_LIMIT);
  CHECK_EQ(a.answer.nodes, 40);
  free(a.memory);
  free(slide.memory);
  for (int status = NSVCD_ROUTE_FOUND; status <= NSVCD_ROUTE_GOAL + 1; status++)
    CHECK(nsvcd_route_status_string((nsvcd_route_status)status)[0] != 0);
}

// A peg of 50 mm by 300 mm on three slides, and meshes about it that rest.
static void robot_gantry(robot *r, const robot_shape *peg, const robot_shape *about) {
  robot_bare(r, NSVCD_JOINT_PRISMATIC, 3, 3, 1);
  for (int j = 0; j < 3; j++) {
    r->joints[j].axis[j] = 1;
    r->parts[j].body = j ? about->body : peg->body;
  }
  r->parts[0].link = 3;
  r->parts[2].pose.position[0] = 0.5f;
  robot_open(r);
}

// Walls about a box of these sides, open above unless it has a lid.
static robot_shape walls(double x, double y, double z, int has_lid) {
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  const double wall = 0.01;
  for (int side = -1; side < 2; side += 2) {
    shapes_box_at(&mesh, side * (x + wall) / 2, 0, 0, wall, y + 2 * wall, z);
    shapes_box_at(&mesh, 0, side * (y + wall) / 2, 0, x, wall, z);
    if (has_lid || side < 0)
      shapes_box_at(&mesh, 0, 0, side * (z + wall) / 2, x + 2 * wall, y + 2 * wall, wall);
  }
  return shape_of(&mesh);
}

// Where nothing is free tries end the search, whatever the nodes are; a start that is as tight as
// proofs can tell is one; and a way out of a hole is found, along a joint.
static void robot_routes_out_of_the_narrow(void) {
  static robot r;
  shapes_mesh box;
  asked_route a;
  memset(&box, 0, sizeof box);
  memset(&a, 0, sizeof a);
  shapes_box(&box, 0.05, 0.05, 0.3, 1);
  robot_shape peg = shape_of(&box);
  for (int kind = 0; kind < 3; kind++) {
    // a room; one that leaves 1 mm everywhere; a hole as narrow
    const double side = kind ? 0.052 : 0.08;
    robot_shape room = walls(side, side, kind ? 0.302 : 0.35, kind < 2);
    robot_gantry(&r, &peg, &room);
    a.goals[0][0] = 0.5;
    a.options.tries = kind < 2 ? 300 : 20000;
    nsvcd_check_answer answer;
    const nsvcd_joint_motion still = {0, 1, a.start, NULL};
    CHECK_EQ(nsvcd_check(r.checker, &still, NULL, &answer), NSVCD_OK);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    ask_route(&r, &a);
    CHECK_EQ(a.answer.status, kind < 2 ? NSVCD_ROUTE_LIMIT : NSVCD_ROUTE_FOUND);
    if (kind < 2) CHECK_EQ(a.answer.checks, 300);
    for (int k = 0; k <= 200 && a.answer.status == NSVCD_ROUTE_FOUND; k++) {
      double q[3];
      nsvcd_motion_at(&a.answer.motion, 3, a.answer.duration * k / 200, q);
      for (int n = 0; n < 2; n++) {
        const double x = fabs(q[0] - 0.5 * n);
        const double y = fabs(q[1]);
        const int is_within = x <= 0.001 && y <= 0.001 && q[2] >= -0.001;
        CHECK(is_within || x >= 0.061 || y >= 0.061 || q[2] >= 0.301 || q[2] <= -0.311);
      }
    }
    free(r.memory);
    free_shape(&room);
  }
  free(a.memory);
  free_shape(&peg);
}

// Of how many questions it is asked before it ends them; and whether it has.
typedef struct countdown {
  int left, is_over;
} countdown;
static int count_down(void *user) {
  countdown *c = (countdown *)user;
  c->is_over |= --c->left < 0;
  return c->is_over;
}

// What is abandoned is not found, and what is found was not abandoned, wherever that comes, in the
// last proof too; nothing is asked any more. The same of a check and an escape.
static void robot_routes_are_abandoned(void) {
  static robot r;
  shapes_rng rng = {101};
  asked_route a;
  nsvcd_check_answer checked;
  nsvcd_check_options options;
  nsvcd_nearest_free_options escape;
  countdown count = {1 << 20, 0};
  memset(&a, 0, sizeof a);
  memset(&options, 0, sizeof options);
  memset(&escape, 0, sizeof escape);
  robot_arm(&r, &rng, 8);
  if (!robot_free_place(&r, &rng, 0.001f, a.start)) return;
  if (!robot_free_place(&r, &rng, 0.001f, a.goals[0])) return;
  a.problem.abandon = count_down;
  a.problem.user = &count;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
  const int all = (1 << 20) - count.left;
  size_t found = 0;
  for (int n = 0; n < 40; n++) {
    count.left = n < 20 ? all * n / 20 : all - (n - 20);
    count.is_over = 0;
    ask_route(&r, &a);
    CHECK_EQ(a.answer.status, count.is_over ? NSVCD_ROUTE_STOPPED : NSVCD_ROUTE_FOUND);
    found += a.answer.status == NSVCD_ROUTE_FOUND;
  }
  CHECK_GE(40 - found, 20);
  const nsvcd_joint_motion motion = {1, 1, a.start, NULL};
  options.stop = escape.stop = count_down;
  options.user = escape.user = &count;
  count.left = 0;
  CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &checked), NSVCD_OK);
  CHECK_EQ(checked.verdict, NSVCD_UNDECIDED);
  CHECK_EQ(checked.why, NSVCD_WHY_WORK);
  CHECK_EQ(checked.sweeps, 0);
  double out[6];
  int is_found = 1;
  // the forearm in the first link
  memset(a.start, 0, sizeof a.start);
  a.start[2] = 3.1;
  CHECK_EQ(nsvcd_nearest_free(r.checker, a.start, &escape, out, &is_found), NSVCD_OK);
  CHECK_EQ(is_found, 0);
  count.left = 1 << 20;
  count.is_over = 0;
  CHECK_EQ(nsvcd_nearest_free(r.checker, a.start, &escape, out, &is_found), NSVCD_OK);
  CHECK_EQ(is_found, 1);
  free(a.memory);
  free(r.memory);
}

static void robot_routes_refuse(void) {
  static robot r;
  shapes_rng rng = {85};
  asked_route a;
  nsvcd_route_answer answer;
  memset(&a, 0, sizeof a);
  memset(&answer, 0x33, sizeof answer);
  const nsvcd_route_answer before = answer;
  robot_arm(&r, &rng, 0);
  a.goals[0][1] = 0.5;
  ask_route(&r, &a);
#define REFUSED_ROUTE(change, back, code)                                                      \
  do {                                                                                         \
    change;                                                                                    \
    CHECK_EQ(nsvcd_route(r.checker, &a.problem, &a.options, a.memory, a.size, &answer), code); \
    CHECK_EQ(memcmp(&answer, &before, sizeof answer), 0);                                      \
    back;                                                                                      \
  } while (0)
  REFUSED_ROUTE(a.start[2] = NAN, a.start[2] = 0, NSVCD_ERROR_VALUE);
  REFUSED_ROUTE(a.goals[0][2] = HUGE_VAL, a.goals[0][2] = 0, NSVCD_ERROR_VALUE);
  REFUSED_ROUTE(a.problem.start = NULL, a.problem.start = a.start, NSVCD_ERROR_ARGUMENT);
  REFUSED_ROUTE(a.problem.goals = NULL, a.problem.goals = a.goals[0], NSVCD_ERROR_ARGUMENT);
  REFUSED_ROUTE(a.problem.goal_count = 0, a.problem.goal_count = 1, NSVCD_ERROR_COUNT);
  REFUSED_ROUTE(a.problem.guess_count = 1, a.problem.guess_count = 0, NSVCD_ERROR_COUNT);
  REFUSED_ROUTE(a.options.clearance = -1, a.options.clearance = 0, NSVCD_ERROR_CLEARANCE);
  REFUSED_ROUTE(a.options.clearance = NAN, a.options.clearance = 0, NSVCD_ERROR_CLEARANCE);
  REFUSED_ROUTE(a.options.edge = NAN, a.options.edge = 0, NSVCD_ERROR_ROUTE);
  REFUSED_ROUTE(a.options.nodes = NSVCD_MAX_NODES + 1, a.options.nodes = 0, NSVCD_ERROR_ROUTE);
  REFUSED_ROUTE(a.options.shortcuts = NSVCD_MAX_NODES + 1, a.options.shortcuts = 0,
                NSVCD_ERROR_ROUTE);
  REFUSED_ROUTE(a.size--, a.size++, NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_route(r.checker, &a.problem, NULL, NULL, a.size, &answer), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_route(r.checker, &a.problem, NULL, a.memory, a.size, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_route(NULL, &a.problem, NULL, a.memory, a.size, &answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_route(r.checker, &a.problem, NULL, a.memory, a.size, &answer), NSVCD_OK);
  free(a.memory);
  free(r.memory);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// No part strays farther than is said, in steps long and short, of one piece and of several, of all
// degrees, whose speeds fit each other or jump; and where joints are many some stray by half of it.
static void robot_strays_no_farther(void) {
  enum { PIECES = 4 };
  static robot r;
  shapes_rng rng = {71};
  double most[NSVCD_MAX_DEGREE + 1] = {0};
  double most_across[3] = {0};
  double often = 0;
  size_t looks = 0;
  for (int trial = 0; trial < (int)check_many(200); trial++) {
    double flat[(PIECES * NSVCD_MAX_DEGREE + 1) * NSVCD_MAX_JOINTS];
    double times[PIECES + 1] = {0};
    const int is_long = trial % 60 == 59;
    robot_random_of(&r, &rng, is_long ? NSVCD_MAX_JOINTS : 1 + (size_t)shapes_pick(&rng, 8));
    robot_open(&r);
    const size_t joints = r.scene.joint_count;
    const size_t degree = 1 + (size_t)shapes_pick(&rng, NSVCD_MAX_DEGREE);
    const size_t pieces = trial % 3 ? 1 : 1 + (size_t)shapes_pick(&rng, PIECES);
    const int jumps = shapes_pick(&rng, 3);  // 0: none; 1: small ones; 2: any
    const nsvcd_joint_motion motion = {pieces, degree, flat, times};
    const size_t steps = (size_t)1 << shapes_pick(&rng, pieces > 1 ? 3 : 5);
    const double size = pow(10, shapes_uniform(&rng, -2, 0.3));
    const double bends = pow(10, shapes_uniform(&rng, -2, 0));
    for (size_t p = 0; p < pieces; p++) times[p + 1] = times[p] + pow(10, shapes_normal(&rng) / 3);
    for (size_t j = 0; j < joints; j++) {
      const double from = shapes_uniform(&rng, -2, 2);
      const double to = shapes_pick(&rng, 4) ? from + size * shapes_normal(&rng) : from;
      for (size_t i = 0; i <= pieces * degree; i++) {
        const double fraction = (double)i / (double)(pieces * degree);
        double *at = &flat[i * joints + j];
        *at = from + fraction * (to - from) + size * bends * shapes_normal(&rng);
        if (i < 2 || i % degree != 1 % degree || jumps == 2) continue;
        const size_t p = (i - 1) / degree;
        const double way = *(at - joints) - *(at - 2 * joints);
        *at = *(at - joints) + way * (times[p + 1] - times[p]) / (times[p] - times[p - 1]);
        if (jumps) *at += 0.1 * size * bends * shapes_normal(&rng);
      }
    }
    for (size_t k = 0; k <= steps; k++) {
      const double by = k == 0 || k == steps ? 0 : shapes_uniform(&rng, -0.3, 0.3);
      r.checker->times[k] = times[pieces] * ((double)k + by) / (double)steps;
    }
    nsvcd__sample(r.checker, &motion, steps);
    // over all steps, two parts stray by no more than their range says
    const nsvcd_body_pair two = {0, (uint32_t)r.scene.part_count - 1};
    nsvcd__step_range range;
    CHECK(nsvcd__steps_near(r.checker, &two, steps, 1e6, &range));
    CHECK(range.first == 0 && range.steps == steps);
    for (size_t k = 0; k < steps; k++) {
      const double off = nsvcd__deviation_in(r.checker, two.a, k);
      CHECK_GE(range.error, off + nsvcd__deviation_in(r.checker, two.b, k));
    }
    for (size_t part = 0; part < r.scene.part_count; part += is_long ? 17 : 1) {
      const nsvcd__member *m = &r.checker->members[part];
      double farthest = 0;
      for (size_t k = 0; k < steps; k++) {
        const oracle_pose a = pose_of_frame(&r.checker->frames[m->row + k]);
        const oracle_pose b = pose_of_frame(&r.checker->frames[m->row + k + 1]);
        for (int look = 1; look < 8; look++) {
          double q[NSVCD_MAX_JOINTS];
          const double x = look / 8.0;
          const double *t = &r.checker->times[k];
          joints_at_time(&motion, joints, t[0] + x * (t[1] - t[0]), q);
          const placed at = placed_part(&r.scene, part, q);
          double off = robot_off(&r, part, &at, &a, &b, x);
          // the share of the step that suits best: the nearest place of its way
          double low = 0;
          double high = 1;
          for (int n = 0; n < 60 && (degree > 1 || pieces > 1); n++) {
            const double u = low + (high - low) / 3;
            const double v = high - (high - low) / 3;
            const double at_u = robot_off(&r, part, &at, &a, &b, u);
            const double at_v = robot_off(&r, part, &at, &a, &b, v);
            low = at_u < at_v ? low : u;
            high = at_u < at_v ? v : high;
            off = fmin(off, fmin(at_u, at_v));
          }
          // the search for the nearest place ends there
          CHECK_LE(off, nsvcd__deviation_in(r.checker, part, k) + 2 * m->rounding + 1e-11);
          farthest = fmax(farthest, off);
        }
      }
      if (m->deviation < 1e-5) continue;
      if (pieces == 1)
        most[degree] = fmax(most[degree], farthest / m->deviation);
      else
        most_across[jumps] = fmax(most_across[jumps], farthest / m->deviation);
      often += farthest / m->deviation;
      looks++;
    }
    free(r.memory);
  }
  printf(
      "  %zu parts, used in the mean %.2f; at most, by degree: %.2f %.2f %.2f %.2f %.2f; across "
      "pieces, by jumps: %.2f %.2f %.2f\n",
      looks, often / (double)looks, most[1], most[2], most[3], most[4], most[5], most_across[0],
      most_across[1], most_across[2]);
  CHECK_GE(most[1], 0.5);
  for (int d = 2; d <= NSVCD_MAX_DEGREE; d++) CHECK_GE(most[d], 0.3);
  for (int d = 0; d < 3; d++) CHECK_GE(most_across[d], 0.3);
}

// During a step no vertex is farther from an axis than its lever, and some are nearly as far.
static void robot_levers_reach(void) {
  static robot r;
  shapes_rng rng = {77};
  double most = 0;
  for (int trial = 0; trial < 400; trial++) {
    nsvcd__step step;
    nsvcd__links from;
    double flat[2 * NSVCD_MAX_JOINTS];
    double moment_arms[NSVCD_MAX_JOINTS] = {0};
    robot_random(&r, &rng);
    robot_open(&r);
    const size_t joints = r.scene.joint_count;
    const double size = pow(10, shapes_uniform(&rng, -1, 0.3));
    for (size_t j = 0; j < joints; j++) {
      flat[j] = shapes_uniform(&rng, -2, 2);
      flat[joints + j] = flat[j] + size * shapes_normal(&rng);
    }
    const nsvcd_joint_motion motion = {1, 1, flat, NULL};
    nsvcd__step_of(&motion, joints, 0, 1, &step);
    nsvcd__place_links(r.checker, flat, &from);
    const size_t part = joints - 1;
    nsvcd__moment_arms_of(r.checker, part, &step, &from, moment_arms);
    for (int k = 0; k <= 20; k++) {
      double q[NSVCD_MAX_JOINTS];
      joints_of_piece(flat, 1, joints, k / 20.0, q);
      const placed at = placed_part(&r.scene, part, q);
      // joints on its path
      for (size_t link = joints; link > 0; link = r.joints[link - 1].parent) {
        const nsvcd_joint *joint = &r.joints[link - 1];
        if (joint->kind == NSVCD_JOINT_PRISMATIC) continue;
        const placed frame = placed_link(&r.scene, link, q);
        double axis[3], turned[3];
        for (int n = 0; n < 3; n++) axis[n] = (double)joint->axis[n];
        oracle_rotate(frame.m, axis, turned);
        const robot_shape *shape = &robot_shapes()[r.shape[part]];
        for (size_t i = 0; i < shape->count; i++) {
          double x[3], off[3], across[3];
          placed_point(&at, scale_of_part(&r.parts[part]), &shape->points[3 * i], x);
          oracle_sub(x, frame.p, off);
          oracle_cross(turned, off, across);
          const double far = oracle_length(across) / oracle_length(turned);
          CHECK_LE(far, moment_arms[link - 1]);
          // where joints beyond have brought it there
          if (k > 0 && size > 0.5 && link + 1 < joints)
            most = fmax(most, far / moment_arms[link - 1]);
        }
      }
    }
    free(r.memory);
  }
  printf("  levers are used to %.2f\n", most);
  CHECK_GE(most, 0.9);
}

// Is a node, or one that it hangs on, among those that were cut off?
static int robot_is_cut(const uint32_t *parents, const uint8_t *cut, size_t node) {
  while (!cut[node] && parents[node] != node) node = parents[node];
  return cut[node];
}

// The nearest node is the nearest one, whatever was added in which order, more than once as well, and
// whatever was cut off.
static void robot_trees_find_the_nearest(void) {
  enum { NODES = 3000 };
  static double points[NODES][NSVCD_MAX_JOINTS];
  static uint32_t parents[NODES], next[NODES];
  static uint8_t marks[NODES], cut[NODES];
  static nsvcd__cell cells[2 * NODES];
  shapes_rng rng = {81};
  size_t gone = 0;
  for (size_t joints = 1; joints <= 7; joints += 3) {
    nsvcd__rrt tree = {joints, 0, 0, &points[0][0], parents, marks, next, cells};
    memset(cut, 0, sizeof cut);
    for (size_t n = 0; n < NODES; n++) {
      double at[NSVCD_MAX_JOINTS];
      for (size_t j = 0; j < joints; j++) {
        at[j] = n % 7 ? shapes_uniform(&rng, -3, 3) : floor(shapes_uniform(&rng, -2, 2));
        if (n % 11 == 0) at[j] = 0.5;
      }
      if (n % 100 == 99) {
        const size_t node = 1 + shapes_pick(&rng, (int)n - 1);
        cut[node] = 1;
        nsvcd__tree_cut(&tree, node);
      }
      if (n > 0) {
        double best = HUGE_VAL;
        for (size_t k = 0; k < n; k++) {
          const double distance2 = nsvcd__distance2(tree.points + k * joints, at, joints);
          const int is_cut = robot_is_cut(parents, cut, k);
          gone += n == NODES - 1 && is_cut;
          best = is_cut ? best : fmin(best, distance2);
        }
        const size_t nearest = nsvcd__tree_nearest(&tree, at);
        CHECK(!robot_is_cut(parents, cut, nearest));
        CHECK_EQ(nsvcd__distance2(tree.points + nearest * joints, at, joints), best);
      }
      CHECK_EQ(nsvcd__tree_add(&tree, at, n > 0 ? nsvcd__tree_nearest(&tree, at) : 0), n);
    }
  }
  printf("  %zu nodes cut off\n", gone);
  CHECK_GE(gone, 100);
  CHECK_LE(gone, 8000);
}

// A ramp ends where it is to, within the limits, is as quick as its slowest joint can be, and goes
// on without a jump.
static void robot_ramps_are_quickest(void) {
  shapes_rng rng = {82};
  size_t blends = 0;
  for (int trial = 0; trial < 20000; trial++) {
    const double speed = pow(10, shapes_uniform(&rng, -1, 1));
    const double most = pow(10, shapes_uniform(&rng, -1, 1));
    const double x1 = shapes_pick(&rng, 5) ? shapes_normal(&rng) : 0;
    const double v0 = shapes_pick(&rng, 3) ? speed * shapes_uniform(&rng, -1, 1) : 0;
    const double v1 = shapes_pick(&rng, 3) ? speed * shapes_uniform(&rng, -1, 1) : 0;
    const double time = nsvcd__blend_time(0, v0, x1, v1, speed, most);
    nsvcd__blend_joint r;
    double x, v;
    if (!(time > 1e-3)) continue;
    CHECK(nsvcd__blend_solve(0, v0, x1, v1, speed * (1 + 1e-9), most * (1 + 1e-9), time, &r));
    nsvcd__blend_at(&r, time, &x, &v);
    CHECK_NEAR(x, x1, 1e-9 * (1 + fabs(x1) + speed * time));
    CHECK_NEAR(v, v1, 1e-9 * (speed + most * time));
    // never faster than the limit, and not quicker with less time
    nsvcd__blend_at(&r, r.t1, &x, &v);
    CHECK_LE(fabs(v), speed * (1 + 1e-8));
    const int sooner = nsvcd__blend_solve(0, v0, x1, v1, speed, most, time * (1 - 1e-3), &r);
    CHECK(!sooner);
    blends++;
  }
  CHECK_GE(blends, 19000);
}

static size_t stops_left, stop_calls;
static int stop_counted(void *user) {
  (void)user;
  stop_calls++;
  return stops_left-- <= 1;
}

// A ring in a hollow ring, 0.5 mm off it all around: one question takes many units. Once it is told to
// stop, a check asks nothing any more.
static void robot_stops_at_once(void) {
  static robot r;
  shapes_mesh mesh;
  double points[2] = {0, 1.5};
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  robot_bare(&r, NSVCD_JOINT_REVOLUTE, 1, 2, 2);
  r.joints[0].axis[2] = 1;
  memset(&mesh, 0, sizeof mesh);
  shapes_torus(&mesh, 0.12, 0.0305, 60, 40);
  for (size_t n = 0; n < mesh.triangles; n++) {  // its inner wall faces inwards
    const uint32_t was = mesh.indices[3 * n];
    mesh.indices[3 * n] = mesh.indices[3 * n + 1];
    mesh.indices[3 * n + 1] = was;
  }
  shapes_torus(&mesh, 0.12, 0.035, 60, 40);
  r.parts[0].body = body_of(&mesh, NULL);
  shapes_free(&mesh);
  shapes_torus(&mesh, 0.12, 0.03, 60, 40);
  r.parts[1].body = body_of(&mesh, NULL);
  r.parts[1].link = 1;
  shapes_free(&mesh);
  robot_open(&r);
  memset(&options, 0, sizeof options);
  options.stop = stop_counted;
  options.work = 10000000;
  stops_left = SIZE_MAX;
  stop_calls = 0;
  CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
  const nsvcd_verdict whole = answer.verdict;
  const size_t all = stop_calls;
  CHECK(all > 30);
  for (size_t n = 1; n <= all + 1; n += 1 + n / 8) {
    stops_left = n;
    stop_calls = 0;
    CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
    CHECK_EQ(stop_calls, n < all ? n : all);
    CHECK(n > all ? answer.verdict == whole : answer.verdict != NSVCD_FREE || n == all);
    if (answer.verdict == NSVCD_UNDECIDED && n < all) CHECK_EQ(answer.why, NSVCD_WHY_WORK);
    // and the next check is not stopped
    CHECK_EQ(r.checker->stop == NULL, 1);
  }
  nsvcd_body_free(r.parts[0].body, NULL);
  nsvcd_body_free(r.parts[1].body, NULL);
  free(r.memory);
}

void test_robot(void) {
  RUN(robot_stops_at_once);
  RUN(robot_parts_are_where_joints_say);
  RUN(robot_limits_are_kept);
  RUN(robot_refuses_bad_input);
  RUN(robot_grazes);
  RUN(robot_swings_past_a_wall);
  RUN(robot_turns_for_long);
  RUN(robot_verdicts_are_right);
  RUN(robot_is_free_until);
  RUN(robot_routes_are_free);
  RUN(robot_routes_end);
  RUN(robot_routes_out_of_the_narrow);
  RUN(robot_routes_are_abandoned);
  RUN(robot_routes_refuse);
  // from within
  RUN(robot_strays_no_farther);
  RUN(robot_levers_reach);
  RUN(robot_trees_find_the_nearest);
  RUN(robot_ramps_are_quickest);
}
CHECK_ALONE(test_robot)
