// test_cones.c - axes that are kept within cones, against kinematics of its own: what is free stays in at
// dense samples, what hits is out where it says; routes, goals and ways out keep them.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "../examples/scenery/shapes.h"
#include "check.h"
#define ROBOT_BALLS 64
#include "route_scene.h"

void test_cones(void);

#define HALF_TURN 3.141592653589793

// By how much an axis is off its direction in a configuration, radians.
static double cone_off(const nsvcd_scene *scene, const nsvcd_cone *cone, const double *q) {
  const placed at = placed_part(scene, cone->part, q);
  double axis[3], direction[3], turned[3], across[3];
  for (int k = 0; k < 3; k++) axis[k] = (double)cone->axis[k];
  for (int k = 0; k < 3; k++) direction[k] = (double)cone->direction[k];
  oracle_rotate(at.m, axis, turned);
  oracle_cross(direction, turned, across);
  return atan2(oracle_length(across), oracle_dot(direction, turned));
}

// Sets a cone about where an axis points in a configuration, or a little beside.
static void cone_about(const nsvcd_scene *scene, shapes_rng *rng, const double *q, double beside,
                       nsvcd_cone *cone) {
  double axis[3], turned[3], off[3];
  const placed at = placed_part(scene, cone->part, q);
  shapes_direction(rng, axis);
  shapes_direction(rng, off);
  oracle_rotate(at.m, axis, turned);
  for (int k = 0; k < 3; k++) {
    cone->axis[k] = (float)(3 * axis[k]);
    cone->direction[k] = (float)(0.1 * (turned[k] + beside * off[k]));
  }
}

static nsvcd_check_answer cone_check(const robot *r, const nsvcd_joint_motion *motion,
                                     double to_time) {
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&options, 0, sizeof options);
  memset(&answer, 0, sizeof answer);
  options.to_time = to_time;
  CHECK_EQ(nsvcd_check(r->checker, motion, &options, &answer), NSVCD_OK);
  return answer;
}

#define DENSE 400  // samples of a piece

// The most that an axis is off in a motion, and when first by more than its angle; HUGE_VAL: never.
static double cone_most(const robot *r, const nsvcd_cone *cone, const nsvcd_joint_motion *m,
                        double *first) {
  double q[NSVCD_MAX_JOINTS];
  double most = 0;
  *first = HUGE_VAL;
  for (size_t k = 0; k <= DENSE * m->pieces; k++) {
    const size_t p = k / DENSE < m->pieces ? k / DENSE : m->pieces - 1;
    const double fraction = (double)(k - p * DENSE) / DENSE;
    joints_of_piece(m->points + p * m->degree * r->scene.joint_count, m->degree,
                    r->scene.joint_count, fraction, q);
    const double off = cone_off(&r->scene, cone, q);
    const double time = m->times[p] + fraction * (m->times[p + 1] - m->times[p]);
    most = fmax(most, off);
    if (off > cone->angle) *first = fmin(*first, time);
  }
  return most;
}

// Random robots and curves: by dense samples.
static void cones_are_kept(void) {
  static robot r;
  shapes_rng rng = {77};
  size_t counts[3] = {0, 0, 0};
  for (size_t trial = 0; trial < check_many(1500); trial++) {
    double points[3 * NSVCD_MAX_DEGREE + 1][8], times[4] = {0};
    double first;
    nsvcd_cone cones[2];
    robot_random(&r, &rng);
    const size_t joints = r.scene.joint_count;
    nsvcd_joint_motion m = {(size_t)(1 + shapes_pick(&rng, 3)),
                            (size_t)(1 + shapes_pick(&rng, NSVCD_MAX_DEGREE)), points[0], times};
    const double far = shapes_pick(&rng, 2) ? 0.2 : 2;
    for (size_t k = 0; k <= m.pieces * m.degree; k++)
      for (size_t j = 0; j < joints; j++)
        points[0][k * joints + j] = (trial % 7 ? 0 : 30) + shapes_uniform(&rng, -far, far);
    for (size_t p = 0; p < m.pieces; p++) times[p + 1] = times[p] + shapes_uniform(&rng, 0.1, 3);
    memset(cones, 0, sizeof cones);
    cones[1].part = (uint32_t)shapes_pick(&rng, (int)r.scene.part_count);
    if (trial % 11 == 0) r.parts[cones[1].part].link = 0;
    cone_about(&r.scene, &rng, points[0], shapes_uniform(&rng, 0, 0.5 * far), &cones[1]);
    // the first one is never left
    cones[0] = cones[1];
    cones[0].angle = 3.1415;
    cones[1].angle = shapes_uniform(&rng, 0.01, trial % 3 ? far : HALF_TURN);
    const double exact = cone_most(&r, &cones[1], &m, &first);
    // just so, or just not
    if (trial % 4 == 0) cones[1].angle = fmin(exact + shapes_uniform(&rng, -1e-4, 1e-4), 3.1415);
    if (!(cones[1].angle > 0)) continue;
    (void)cone_most(&r, &cones[1], &m, &first);
    r.scene.pair_count = 0;
    r.scene.cones = cones;
    r.scene.cone_count = 2;
    robot_open(&r);
    const nsvcd_check_answer answer = cone_check(&r, &m, trial % 2 ? 0 : 1e-6);
    const int is_known = exact < 3.1414;
    counts[answer.verdict]++;
    CHECK_EQ(answer.pair, NSVCD_NONE);
    if (answer.verdict == NSVCD_FREE) {
      CHECK_LE(exact, cones[1].angle + 1e-12);
      CHECK_EQ(answer.cone, NSVCD_NONE);
      CHECK_EQ(answer.free_until, times[m.pieces]);
    } else if (is_known) {
      double q[NSVCD_MAX_JOINTS];
      CHECK_EQ(answer.cone, 1);
      CHECK_LE(answer.free_until, first + 1e-9);
      joints_of_piece(m.points + answer.piece * m.degree * joints, m.degree, joints,
                      answer.fraction, q);
      const double off = cone_off(&r.scene, &cones[1], q);
      if (answer.verdict == NSVCD_HIT) CHECK_GE(off, cones[1].angle);
      // with to_time it is the first one
      const double at =
          times[answer.piece] + answer.fraction * (times[answer.piece + 1] - times[answer.piece]);
      if (answer.verdict == NSVCD_HIT && trial % 2 == 0) CHECK_LE(at, first + 2e-6);
    }
    // what is clearly in, or out, is known to be
    if (exact < cones[1].angle - 1e-3 && is_known) CHECK_EQ(answer.verdict, NSVCD_FREE);
    if (exact > cones[1].angle + 1e-6 && is_known) CHECK_EQ(answer.verdict, NSVCD_HIT);
    const nsvcd_joint_motion still = {0, 0, points[0], NULL};
    const double start_off = cone_off(&r.scene, &cones[1], points[0]);
    if (start_off < cones[1].angle - 1e-9) CHECK_EQ(cone_check(&r, &still, 0).verdict, NSVCD_FREE);
    if (start_off > cones[1].angle + 1e-9) CHECK_EQ(cone_check(&r, &still, 0).verdict, NSVCD_HIT);
    free(r.memory);
  }
  CHECK_GE(counts[NSVCD_FREE], 300);
  CHECK_GE(counts[NSVCD_HIT], 300);
  CHECK_LE(counts[NSVCD_UNDECIDED], 5);
}

// A joint that turns about x, and one that slides along y, with a box upright on them.
static void cone_bare(robot *r, nsvcd_cone *cone, double angle) {
  const nsvcd_cone upright = {0, {0, 0, 2}, {0, 0, 1}, angle};
  robot_bare(r, NSVCD_JOINT_REVOLUTE, 2, 2, 30);
  r->joints[0].axis[0] = 1;
  r->joints[1].axis[1] = 1;
  r->joints[1].kind = NSVCD_JOINT_PRISMATIC;
  for (int n = 0; n < 2; n++) r->parts[n].body = robot_shapes()[0].body;
  r->parts[0].link = 2;
  r->parts[1].pose.position[1] = 1;
  *cone = upright;
  r->scene.cones = cone;
  r->scene.cone_count = 1;
}

// Curves that leave a cone between their ends, by little, or for short.
static void cones_are_left_between_the_ends(void) {
  static robot r;
  nsvcd_cone cone;
  for (int n = 0; n < 40; n++) {
    const double angle = 0.003 * (n + 1);
    const double peak = n % 2 ? angle + 1e-6 : angle - 1e-6;
    const double curve[6] = {0, 0, 2 * peak, 0, 0, 0};
    const double corner[10] = {0, 0, 0, 0, peak, 0, 0, 0, 0, 0};
    const double times[5] = {0, 1, 1 + 1e-5, 1 + 2e-5, 3};
    const nsvcd_joint_motion motions[2] = {{1, 2, curve, NULL}, {4, 1, corner, times}};
    cone_bare(&r, &cone, angle);
    robot_open(&r);
    for (int k = 0; k < 2; k++) {
      const nsvcd_check_answer answer = cone_check(&r, &motions[k], 0);
      CHECK_EQ(answer.verdict, n % 2 ? NSVCD_HIT : NSVCD_FREE);
      CHECK_EQ(answer.cone, n % 2 ? 0 : NSVCD_NONE);
    }
    // a motion that touches the cone is either, or open, but ends
    const double touching[6] = {0, 0, 2 * angle, 0, 0, 0};
    const nsvcd_joint_motion touches = {1, 2, touching, NULL};
    const nsvcd_check_answer answer = cone_check(&r, &touches, 0);
    if (answer.verdict == NSVCD_UNDECIDED) CHECK_EQ(answer.why, NSVCD_WHY_TOO_NEAR);
    free(r.memory);
  }
}

// What slides does not turn; what turns without limits comes back; all but a little is allowed; the world.
static void cones_of_all_kinds(void) {
  static robot r;
  nsvcd_cone cone;
  const double slides[4] = {0.0999, 0, 0.0999, 0.5};
  const double turns[4] = {0, 0, 8 * HALF_TURN, 0};
  const nsvcd_joint_motion sliding = {1, 1, slides, NULL};
  const nsvcd_joint_motion turning = {1, 1, turns, NULL};
  cone_bare(&r, &cone, 0.1);
  robot_open(&r);
  CHECK_EQ(cone_check(&r, &sliding, 0).verdict, NSVCD_FREE);
  CHECK_EQ(cone_check(&r, &turning, 0).verdict, NSVCD_HIT);
  const nsvcd_joint_motion turned = {0, 0, turns + 2, NULL};
  CHECK_EQ(cone_check(&r, &turned, 0).verdict, NSVCD_FREE);
  free(r.memory);
  cone_bare(&r, &cone, 3.14);
  robot_open(&r);
  CHECK_EQ(cone_check(&r, &turning, 0).verdict, NSVCD_HIT);
  const double nearly[4] = {-3.139, 0, 3.139, 0};
  const nsvcd_joint_motion round = {1, 1, nearly, NULL};
  CHECK_EQ(cone_check(&r, &round, 0).verdict, NSVCD_FREE);
  free(r.memory);
  // about its own axis
  cone_bare(&r, &cone, 1e-3);
  cone.axis[0] = cone.direction[0] = 1;
  cone.axis[2] = cone.direction[2] = 0;
  robot_open(&r);
  CHECK_EQ(cone_check(&r, &turning, 0).verdict, NSVCD_FREE);
  free(r.memory);
  // of a part that rests
  cone_bare(&r, &cone, 0.1);
  cone.part = 1;
  robot_open(&r);
  CHECK_EQ(cone_check(&r, &turning, 0).verdict, NSVCD_FREE);
  free(r.memory);
  cone.direction[1] = 1;
  robot_open(&r);
  CHECK_EQ(cone_check(&r, &sliding, 0).verdict, NSVCD_HIT);
  free(r.memory);
}

// Which comes first, a wall or the edge of the cone: with to_time the first is named.
static void cones_and_pairs_take_turns(void) {
  static robot r;
  nsvcd_cone cone;
  for (int n = 0; n < 20; n++) {
    // the boxes meet when it has slid 0.9
    const double tilt = 0.05 + 0.01 * n;
    const double points[4] = {0, 0, tilt, 2};
    const nsvcd_joint_motion motion = {1, 1, points, NULL};
    cone_bare(&r, &cone, 0.1);
    robot_open(&r);
    const nsvcd_check_answer answer = cone_check(&r, &motion, 1e-5);
    const double leaves = 0.1 / tilt;
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_LE(answer.free_until, answer.fraction);
    CHECK_LE(answer.fraction, answer.free_until + 1e-5);
    if (leaves < 0.44) CHECK_NEAR(answer.fraction, leaves, 1e-5);
    if (leaves < 0.44) CHECK(answer.cone == 0 && answer.pair == NSVCD_NONE);
    if (leaves > 0.46) CHECK(answer.cone == NSVCD_NONE && answer.pair == 0);
    free(r.memory);
  }
}

// An arm carries a cup from one side of its base to the other, upright, among boxes.
static size_t cone_route(double angle, uint64_t seed, const nsvcd_route_options *o,
                         double *seconds) {
  static robot r;
  static asked_route a;
  static const double ends[2] = {-1.5, 1.5};
  shapes_rng rng = {4};
  const nsvcd_cone cone = {5, {-1, 0, 0}, {0, 0, 1}, angle};
  robot_arm(&r, &rng, 6);
  free(r.memory);
  for (int j = 0; j < 6; j++) r.joints[j].speed = r.joints[j].acceleration = 1;
  r.scene.cones = &cone;
  r.scene.cone_count = 1;
  robot_open(&r);
  memset(&a.problem, 0, sizeof a.problem);
  for (int e = 0; e < 2; e++) {
    double *q = e ? a.goals[0] : a.start;
    nsvcd_check_answer found;
    do {
      for (int j = 0; j < 6; j++) q[j] = j ? shapes_uniform(&rng, -2, 2) : ends[e];
      if (!nsvcd__into_cones(r.checker, NULL, 0.1, q)) continue;
      const nsvcd_joint_motion still = {0, 0, q, NULL};
      const nsvcd_check_options asked = {2e-3f, 0, 0, NULL, NULL, 0};
      CHECK_EQ(nsvcd_check(r.checker, &still, &asked, &found), NSVCD_OK);
    } while (cone_off(&r.scene, &cone, q) > angle || found.verdict != NSVCD_FREE);
  }
  a.options = *o;
  a.options.seed = seed;
  const clock_t began = clock();
  ask_route(&r, &a);
  *seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
  const nsvcd_joint_motion *m = &a.answer.motion;
  const size_t is_found = a.answer.status == NSVCD_ROUTE_FOUND;
  for (int k = 0; k <= 2000 && is_found; k++) {
    double q[6];
    joints_at_time(m, 6, a.answer.duration * k / 2000, q);
    CHECK_LE(cone_off(&r.scene, &cone, q), angle + 1e-12);
  }
  if (is_found) robot_motion_is_smooth(&r, m, a.start, a.goals[0]);
  if (is_found) CHECK_EQ(cone_check(&r, m, 0).verdict, NSVCD_FREE);
  // tilted at the start, or at the goal
  const double was = a.start[5];
  a.start[5] += a.start[5] > 0 ? -2 * angle : 2 * angle;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_START);
  CHECK_EQ(a.answer.check.cone, 0);
  a.start[5] = was;
  a.goals[0][5] += a.goals[0][5] > 0 ? -2 * angle : 2 * angle;
  ask_route(&r, &a);
  CHECK_EQ(a.answer.status, NSVCD_ROUTE_GOAL);
  free(r.memory);
  return is_found;
}

static int cone_order(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}
static void routes_keep_cones(void) {
  static const double angles[3] = {0.2, 0.05, 0.02};
  nsvcd_route_options options;
  memset(&options, 0, sizeof options);
  for (int n = 0; n < 3; n++) {
    size_t found = 0;
    double seconds[21];
    options.looks = 0;
    for (uint64_t seed = 0; seed < 20; seed++)
      found += cone_route(angles[n], seed, &options, &seconds[seed]);
    CHECK_EQ(found, 20);
    options.looks = NSVCD_NONE;
    CHECK_EQ(cone_route(angles[n], 1, &options, &seconds[20]), 1);
    qsort(seconds, 20, sizeof *seconds, cone_order);
    printf("  within %.2f: 20 seeds, %.1f ms, at most %.1f ms; without looks %.1f ms\n", angles[n],
           1e3 * seconds[10], 1e3 * seconds[19], 1e3 * seconds[20]);
  }
}

// Goals are in cones, where there are such: of a tool that may turn, of a box, of a link on the way.
static void goals_keep_cones(void) {
  static robot r;
  static double out[16][6];
  shapes_rng rng = {9};
  size_t counts[2] = {0, 0};
  for (int trial = 0; trial < 60; trial++) {
    nsvcd_reach_problem problem;
    nsvcd_reach_options options;
    nsvcd_reach_answer answer;
    double q[6];
    const double start[6] = {0};
    nsvcd_pose poses[6];
    robot_arm(&r, &rng, 0);
    for (int j = 0; j < 6; j++) q[j] = shapes_uniform(&rng, -2.5, 2.5);
    nsvcd_forward_kinematics(r.checker, q, poses);
    free(r.memory);
    r.scene.pair_count = 0;
    nsvcd_cone cone = {trial % 2 ? 5 : 3, {0, 0, 0}, {0, 0, 0}, 0.02};
    cone_about(&r.scene, &rng, q, 0, &cone);
    memset(&problem, 0, sizeof problem);
    memset(&options, 0, sizeof options);
    problem.start = start;
    problem.link = 6;
    problem.tool = r.parts[5].pose;
    problem.target = poses[5];
    // anywhere about a point, however turned about its z: what the cone leaves of that
    problem.half[0] = problem.half[1] = problem.half[2] = 0.1f;
    problem.free_axis[2] = 1;
    options.may_touch = trial % 4 == 0;
    for (int has = 0; has < 2; has++) {
      r.scene.cones = &cone;
      r.scene.cone_count = (size_t)has;
      robot_open(&r);
      CHECK_EQ(nsvcd_reach(r.checker, &problem, &options, out[0], 16, &answer), NSVCD_OK);
      size_t in = 0;
      for (size_t n = 0; n < answer.solutions; n++)
        in += cone_off(&r.scene, &cone, out[n]) <= cone.angle;
      if (has) CHECK_EQ(in, answer.solutions);
      counts[has] += in > 0;
      free(r.memory);
    }
  }
  // few by chance, many by will
  printf("  in a cone by chance %zu of 60, by will %zu\n", counts[0], counts[1]);
  CHECK_LE(counts[0], 30);
  CHECK_GE(counts[1], 57);
}

// Out of a cone: the way out leads into it, and is near.
static void ways_out_lead_into_cones(void) {
  static robot r;
  shapes_rng rng = {12};
  for (int trial = 0; trial < 20; trial++) {
    double q[6], out[6];
    int is_found = 0;
    robot_arm(&r, &rng, 0);
    free(r.memory);
    r.scene.pair_count = 0;
    for (int j = 0; j < 6; j++) q[j] = shapes_uniform(&rng, -2.5, 2.5);
    nsvcd_cone cone = {5, {0, 0, 0}, {0, 0, 0}, 0.01};
    cone_about(&r.scene, &rng, q, 0.25, &cone);
    r.scene.cones = &cone;
    r.scene.cone_count = 1;
    robot_open(&r);
    const double off = cone_off(&r.scene, &cone, q);
    CHECK_EQ(nsvcd_nearest_free(r.checker, q, NULL, out, &is_found), NSVCD_OK);
    CHECK_EQ(is_found, 1);
    double sum = 0;
    for (int j = 0; j < 6; j++) sum += (out[j] - q[j]) * (out[j] - q[j]);
    CHECK_LE(cone_off(&r.scene, &cone, out), cone.angle);
    CHECK_LE(sqrt(sum), 0.5);
    if (off <= 0.01) CHECK_EQ(sum, 0);
    // none is told that is farther than asked for
    for (int n = 1; n < 10; n++) {
      nsvcd_nearest_free_options options;
      memset(&options, 0, sizeof options);
      options.farthest = 0.1 * n * sqrt(sum) + 1e-3;
      CHECK_EQ(nsvcd_nearest_free(r.checker, q, &options, out, &is_found), NSVCD_OK);
      double way = 0;
      for (int j = 0; j < 6; j++) way += (out[j] - q[j]) * (out[j] - q[j]);
      if (is_found) CHECK_LE(sqrt(way), options.farthest * (1 + 1e-6));
    }
    free(r.memory);
  }
}

// A part that is held at a tilt while it turns about the vertical, and may tilt.
static void cone_turning(robot *r, nsvcd_cone *cone, double angle) {
  cone_bare(r, cone, angle);
  memset(r->joints[0].axis, 0, sizeof r->joints[0].axis);
  r->joints[0].axis[2] = 1;
  r->joints[0].low = -400;
  r->joints[0].high = 400;
  r->joints[1].kind = NSVCD_JOINT_REVOLUTE;
  r->joints[1].axis[1] = 0;
  r->joints[1].axis[0] = 1;
  for (int j = 0; j < 2; j++) r->joints[j].speed = r->joints[j].acceleration = 1;
  r->parts[1].pose.position[1] = 10;
  robot_open(r);
}

// A start or a goal as near to the edge of its cone as can be is refused, and the cone is named, or
// motions into the cone are free.
static void edges_of_cones_are_left(void) {
  static robot r;
  static asked_route a;
  shapes_rng rng = {15};
  nsvcd_cone cone;
  size_t counts[2] = {0, 0};
  for (int trial = 0; trial < 300; trial++) {
    const double angle = trial % 3 ? shapes_uniform(&rng, 0.1, 1.5) : 0.01;
    const double beside = pow(10, shapes_uniform(&rng, -14, -8));
    cone_turning(&r, &cone, angle);
    a.options.nodes = 100;
    a.start[0] = shapes_uniform(&rng, -0.5, 0.5);
    a.start[1] = angle - beside;
    a.goals[0][0] = shapes_uniform(&rng, -0.5, 0.5);
    a.goals[0][1] = (trial % 2 ? -1 : 0.5) * a.start[1];
    ask_route(&r, &a);
    const int is_found = a.answer.status == NSVCD_ROUTE_FOUND;
    CHECK(is_found || a.answer.status == NSVCD_ROUTE_START);
    if (!is_found) CHECK_EQ(a.answer.check.cone, 0);
    if (beside * sin(angle) > 2e-13) CHECK(is_found);
    counts[is_found]++;
    for (int k = 0; k <= 100 && is_found; k++) {
      double q[6];
      joints_at_time(&a.answer.motion, 2, a.answer.duration * k / 100, q);
      CHECK_LE(cone_off(&r.scene, &cone, q), angle + 1e-12);
    }
    free(r.memory);
  }
  CHECK_GE(counts[0], 20);
  CHECK_GE(counts[1], 150);
  free(a.memory);
}

typedef struct cone_countdown {
  int left, after;
} cone_countdown;
static int cone_count_down(void *user) {
  cone_countdown *c = (cone_countdown *)user;
  if (c->left > 0)
    c->left--;
  else
    c->after++;
  return c->after > 0;
}

// Along the edge of a cone steps are short: whoever asks can end them.
static void cones_end_when_told(void) {
  static robot r;
  static asked_route a;
  nsvcd_cone cone;
  cone_turning(&r, &cone, 0.1);
  a.start[1] = a.goals[0][1] = 0.1 - 1e-8;
  a.goals[0][0] = 20;
  const double points[4] = {0, a.start[1], 20, a.start[1]};
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  for (int n = 0; n < 50; n += 7) {
    nsvcd_check_options options;
    nsvcd_check_answer answer;
    cone_countdown count = {n, 0};
    memset(&options, 0, sizeof options);
    options.to_time = n % 2 ? 1e-3 : 0;
    options.stop = cone_count_down;
    options.user = &count;
    CHECK_EQ(nsvcd_check(r.checker, &motion, &options, &answer), NSVCD_OK);
    CHECK_EQ(answer.verdict, NSVCD_UNDECIDED);
    CHECK_EQ(answer.why, NSVCD_WHY_WORK);
    CHECK_EQ(answer.cone, 0);
    CHECK_EQ(count.after, 1);
    if (answer.verdict != NSVCD_UNDECIDED) break;  // a route would take hours
    // by looks, and by proofs
    count.left = 20 + n;
    count.after = 0;
    a.problem.abandon = cone_count_down;
    a.problem.user = &count;
    a.options.tries = 100;
    a.options.looks = n % 2 ? 100 : NSVCD_NONE;
    ask_route(&r, &a);
    CHECK_EQ(a.answer.status, NSVCD_ROUTE_STOPPED);
    CHECK_LE(count.after, 3);
  }
  free(a.memory);
  free(r.memory);
}

static void cones_are_checked(void) {
  static robot r;
  static const float odd[3][3] = {{0, 0, 0}, {NAN, 0, 1}, {0, HUGE_VALF, 0}};
  static const double angles[6] = {0, -1, 3.141592653589794, 7, NAN, HUGE_VAL};
  nsvcd_checker *checker = NULL;
  nsvcd_range_answer range;
  nsvcd_cone cone;
  cone_bare(&r, &cone, 1);
  robot_open(&r);
  const size_t size = nsvcd_checker_size(&r.scene);
#define REFUSED_AS(code)                     \
  CHECK_EQ(nsvcd_checker_size(&r.scene), 0); \
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), code)
  for (int n = 0; n < 3; n++) {
    const nsvcd_cone was = cone;
    memcpy(cone.axis, odd[n], sizeof odd[n]);
    REFUSED_AS(NSVCD_ERROR_AXIS);
    cone = was;
    memcpy(cone.direction, odd[n], sizeof odd[n]);
    REFUSED_AS(NSVCD_ERROR_AXIS);
    cone = was;
  }
  for (int n = 0; n < 6; n++) {
    cone.angle = angles[n];
    REFUSED_AS(NSVCD_ERROR_CONE);
  }
  cone.angle = 1;
  cone.part = 2;
  REFUSED_AS(NSVCD_ERROR_LINK);
  cone.part = 0;
  r.scene.cones = NULL;
  REFUSED_AS(NSVCD_ERROR_ARGUMENT);
  free(r.memory);
  // what two parts do is asked without cones: they never meet, and no configuration is in the cone
  cone.direction[2] = -1;
  r.scene.cones = &cone;
  r.joints[1].low = -0.5;
  r.joints[1].high = 0.5;
  robot_open(&r);
  const nsvcd_body_pair pair = {0, 1};
  const size_t room = nsvcd_pair_range_size(r.checker, pair, NULL);
  void *memory = malloc(room);
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, NULL, memory, room, &range), NSVCD_OK);
  CHECK_EQ(range.meeting, NSVCD_MEETS_NEVER);
  free(memory);
  free(r.memory);
}

void test_cones(void) {
  RUN(cones_are_kept);
  RUN(cones_are_left_between_the_ends);
  RUN(cones_of_all_kinds);
  RUN(cones_and_pairs_take_turns);
  RUN(routes_keep_cones);
  RUN(goals_keep_cones);
  RUN(ways_out_lead_into_cones);
  RUN(edges_of_cones_are_left);
  RUN(cones_end_when_told);
  RUN(cones_are_checked);
}
CHECK_ALONE(test_cones)
