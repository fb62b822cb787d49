// test_allowances.c - contact that is allowed near a configuration: a box on a table that is taken away, and
// put down; jaws that hold it; and, of random robots, that nothing touches farther from there.
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

void test_allowances(void);

#define HELD 5e-3  // metres, that an allowance gives

// A gantry, x, y, z and a turn about z, holds a box of 0.1 m on a table, 0.1 mm in it, between two jaws:
// one is fixed, the other slides. pairs: the box with the table, the box with the jaw that slides.
enum { BOX, TABLE, JAW, WALL };
static void taker_make(robot *r) {
  static const nsvcd_body *table;
  if (!table) {
    shapes_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    shapes_box(&mesh, 1.2, 1.2, 0.08, 1);
    table = body_of(&mesh, NULL);
    shapes_free(&mesh);
  }
  robot_bare(r, NSVCD_JOINT_PRISMATIC, 5, 4, 1);
  for (uint32_t j = 0; j < 3; j++) r->joints[j].axis[j] = 1;
  r->joints[3].kind = NSVCD_JOINT_REVOLUTE;
  r->joints[3].axis[2] = 1;
  r->joints[4].axis[0] = 1;
  for (uint32_t n = 0; n < 4; n++) r->parts[n].body = n == TABLE ? table : robot_shapes()[0].body;
  r->parts[BOX].link = 4;
  r->parts[BOX].pose.position[2] = 0.0599f;
  r->parts[TABLE].pose.position[2] = -0.03f;
  r->parts[JAW].link = 5;
  r->parts[JAW].scale = 0.2f;
  r->parts[JAW].pose.position[0] = 0.06f;
  r->parts[JAW].pose.position[2] = 0.08f;
  r->parts[WALL].pose.position[0] = 0.5f;
  r->scene.pair_count = 4;
  const nsvcd_body_pair pairs[4] = {{BOX, TABLE}, {BOX, JAW}, {BOX, WALL}, {JAW, WALL}};
  memcpy(r->pairs, pairs, sizeof pairs);
}

static nsvcd_check_answer taker_check(const robot *r, const double *points, size_t pieces) {
  const nsvcd_joint_motion motion = {pieces, 1, points, NULL};
  nsvcd_check_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_check(r->checker, &motion, NULL, &answer), NSVCD_OK);
  return answer;
}

static void a_box_is_taken_from_a_table(void) {
  static robot r;
  const double start[5] = {0, 0, 0, 0, 0};
  const double away[5] = {0.2, 0.1, 0.3, 0.7, 0};
  nsvcd_allowance allowances[4] = {
      {0, start, HELD}, {1, start, HELD}, {0, away, HELD}, {0, start, 0}};
  double points[4][5];
  taker_make(&r);
  memset(points, 0, sizeof points);
  points[1][2] = 0.2;
  // without an allowance
  robot_open(&r);
  CHECK(taker_check(&r, points[0], 0).verdict != NSVCD_FREE);
  CHECK(taker_check(&r, points[0], 1).verdict != NSVCD_FREE);
  free(r.memory);
  // of the table alone: the jaw still touches
  r.scene.allowances = allowances;
  r.scene.allowance_count = 1;
  robot_open(&r);
  nsvcd_check_answer answer = taker_check(&r, points[0], 1);
  CHECK(answer.verdict != NSVCD_FREE);
  CHECK_EQ(answer.pair, 1);
  free(r.memory);
  r.scene.allowance_count = 2;
  robot_open(&r);
  CHECK_EQ(taker_check(&r, points[0], 0).verdict, NSVCD_FREE);
  CHECK_EQ(taker_check(&r, points[0], 1).verdict, NSVCD_FREE);
  // back onto the table is where it was; beside that it hits
  CHECK_EQ(taker_check(&r, points[0], 2).verdict, NSVCD_FREE);
  points[2][0] = 0.1;
  answer = taker_check(&r, points[0], 2);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_EQ(answer.pair, 0);
  CHECK_EQ(answer.piece, 1);
  // it slides, and is let down farther than it may
  points[1][2] = 0;
  points[1][0] = 0.3;
  answer = taker_check(&r, points[0], 1);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_GE(answer.fraction, 0.999 * HELD / 0.3);
  points[1][0] = 0.99 * HELD;
  CHECK_EQ(taker_check(&r, points[0], 1).verdict, NSVCD_FREE);
  points[1][0] = 1.01 * HELD;
  CHECK_EQ(taker_check(&r, points[0], 1).verdict, NSVCD_HIT);
  // the jaw opens, a little, and then into the box
  points[1][0] = 0;
  points[1][4] = -0.99 * HELD;
  CHECK_EQ(taker_check(&r, points[0], 1).verdict, NSVCD_FREE);
  points[1][4] = -1.01 * HELD;
  CHECK_EQ(taker_check(&r, points[0], 1).verdict, NSVCD_HIT);
  free(r.memory);
  // nothing may move
  r.scene.allowances = allowances + 3;
  r.scene.allowance_count = 1;
  r.scene.pair_count = 1;
  robot_open(&r);
  memset(points, 0, sizeof points);
  CHECK_EQ(taker_check(&r, points[0], 0).verdict, NSVCD_FREE);
  points[1][2] = 0.2;
  CHECK(taker_check(&r, points[0], 1).verdict != NSVCD_FREE);
  free(r.memory);
}

// How far the points of one part of a pair are from where they are in another configuration, at most,
// as the world sees them; its joints carry it alone.
static double moved_by(const robot *r, size_t part, const double *from, const double *to) {
  const robot_shape *shape = &robot_shapes()[r->shape[part]];
  const placed at[2] = {placed_part(&r->scene, part, from), placed_part(&r->scene, part, to)};
  double most = 0;
  for (size_t k = 0; k < shape->count; k++) {
    double x[2][3], off[3];
    for (int n = 0; n < 2; n++)
      placed_point(&at[n], scale_of_part(&r->parts[part]), shape->points + 3 * k, x[n]);
    oracle_sub(x[0], x[1], off);
    most = fmax(most, oracle_length(off));
  }
  return most;
}

// Random robots that touch something at a start: where a motion from there is said to be free, points
// that are farther from the start than is allowed belong to parts that do not touch.
static void nothing_touches_farther_away(void) {
  shapes_rng rng = {77};
  size_t free_ones = 0;
  size_t touching = 0;
  for (int n = 0; n < 400; n++) {
    static robot r;
    double points[4 * NSVCD_MAX_JOINTS];
    robot_random_of(&r, &rng, 1 + (size_t)shapes_pick(&rng, 4));
    const size_t joints = r.scene.joint_count;
    const size_t degree = 1 + (size_t)shapes_pick(&rng, 3);
    const size_t mover = joints - 1;
    const size_t alone =
        (size_t)shapes_pick(&rng, 2 * (int)joints);  // the joint that moves, or all
    r.parts[mover].scale = 0;
    for (size_t i = 0; i < 4 * joints; i++) {
      const double reach = i < joints ? 2 : 0.4;
      const double by = shapes_uniform(&rng, -reach, reach);
      const int moves = i < joints || alone >= joints || i % joints == alone;
      points[i] = (i < joints ? 0 : points[i % joints]) + (moves ? by : 0);
    }
    // a box in the world, which a point of the part that moves last touches at the start
    r.parts[joints].body = robot_shapes()[0].body;
    r.shape[joints] = 0;
    const placed at = placed_part(&r.scene, mover, points);
    const robot_shape *shape = &robot_shapes()[r.shape[mover]];
    double x[3];
    placed_point(&at, scale_of_part(&r.parts[mover]),
                 shape->points + 3 * (size_t)shapes_pick(&rng, (int)shape->count), x);
    for (int k = 0; k < 3; k++)
      r.parts[joints].pose.position[k] = (float)(x[k] + shapes_uniform(&rng, -0.05, 0.05));
    r.parts[joints].pose.rotation[3] = 1;
    r.scene.part_count = joints + 1;
    r.pairs[0].a = (uint32_t)mover;
    r.pairs[0].b = (uint32_t)joints;
    r.scene.pair_count = 1;
    const nsvcd_allowance allowance = {0, points, 0.02 * pow(20, shapes_uniform(&rng, 0, 1))};
    r.scene.allowances = &allowance;
    r.scene.allowance_count = 1;
    robot_open(&r);
    const nsvcd_joint_motion motion = {1, degree, points, NULL};
    nsvcd_check_answer answer;
    CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_OK);
    free(r.memory);
    if (answer.verdict != NSVCD_FREE) continue;
    free_ones++;
    for (int k = 0; k <= 200; k++) {
      double q[NSVCD_MAX_JOINTS];
      joints_of_piece(points, degree, joints, k / 200.0, q);
      const placed now[2] = {placed_part(&r.scene, mover, q), placed_part(&r.scene, joints, q)};
      const oracle_pose poses[2] = {oracle_of(&now[0]), oracle_of(&now[1])};
      const oracle_mesh *a = &robot_shapes()[r.shape[mover]].exact;
      const oracle_mesh *b = &robot_shapes()[0].exact;
      oracle_search search;
      oracle_search_begin(&search, a, b);
      if (oracle_search_run(&search, &poses[0], &poses[1], 1e-6) > 1e-7) continue;
      touching++;
      CHECK_LE(moved_by(&r, mover, points, q), allowance.distance);
    }
  }
  CHECK_GE(free_ones, 40);
  CHECK_GE(touching, 100);
}

// From the table to the table, by looks and without: found, and nothing else is touched on the way.
static void routes_take_and_put_down(void) {
  for (int looks = 0; looks < 2; looks++) {
    static robot r;
    asked_route a;
    const double start[5] = {0, 0, 0, 0, 0};
    const double goal[5] = {-0.3, 0.2, 0, 1, 0};
    const nsvcd_allowance allowances[3] = {{0, start, HELD}, {0, goal, HELD}, {1, start, HELD}};
    taker_make(&r);
    for (uint32_t j = 0; j < 5; j++) {
      r.joints[j].speed = 1;
      r.joints[j].acceleration = 2;
    }
    r.joints[4].low = r.joints[4].high = 0;
    r.scene.allowances = allowances;
    r.scene.allowance_count = 3;
    robot_open(&r);
    memset(&a, 0, sizeof a);
    memcpy(a.start, start, sizeof start);
    memcpy(a.goals[0], goal, sizeof goal);
    a.options.looks = looks ? 0 : NSVCD_NONE;
    ask_route(&r, &a);
    CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
    if (looks) CHECK_LE(a.answer.checks, 10);
    if (a.answer.status == NSVCD_ROUTE_FOUND) {
      const nsvcd_joint_motion *m = &a.answer.motion;
      double highest = 0;
      for (int k = 0; k <= 1000; k++) {
        double q[5];
        joints_at_time(m, 5, a.answer.duration * k / 1000.0, q);
        highest = fmax(highest, q[2]);
        double near_end = 0;
        for (int j = 0; j < 2; j++)
          near_end = fmax(near_end, fmin(fabs(q[j] - start[j]), fabs(q[j] - goal[j])));
        if (near_end > HELD) CHECK_GE(q[2], 0.1e-3);
      }
      CHECK_GE(highest, 0.1e-3);
    }
    free(a.memory);
    free(r.memory);
  }
}

// A slide of 0.3 m in 2 s, then a turn: until when a box of it may touch, from either end; errors.
static void allowed_until_it_is_too_far(void) {
  static robot r;
  const double points[15] = {0, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, 0.3, 0, 0, 1, 0};
  const double times[3] = {10, 12, 13}, falling[3] = {10, 12, 11};
  const nsvcd_joint_motion motion = {2, 1, points, times};
  nsvcd_joint_motion other = motion;
  nsvcd_allowance allowance = {0, points, HELD};
  double time = 0;
  taker_make(&r);
  robot_open(&r);
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 0, &time), NSVCD_OK);
  CHECK_NEAR(time, 10 + HELD / 0.15, 1e-8);
  CHECK_LE(time, 10 + HELD / 0.15);
  allowance.joints = points + 10;
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 1, &time), NSVCD_OK);
  // a radian a second: the corner that is farthest from the turn's axis goes no farther than is allowed
  CHECK_GE(time, 13 - HELD / (0.05 * sqrt(2)));
  CHECK_LE(time, 13 - HELD / 0.3);
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 0, &time), NSVCD_OK);
  CHECK_NEAR(time, 10, 0);
  // the jaw does not slide
  allowance.pair = 1;
  allowance.distance = 0;
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 0, &time), NSVCD_OK);
  CHECK_NEAR(time, 13, 0);
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 1, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_allowed_until(NULL, &allowance, &motion, 1, &time), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_allowed_until(r.checker, NULL, &motion, 1, &time), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, NULL, 1, &time), NSVCD_ERROR_ARGUMENT);
  other.times = falling;
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &other, 1, &time), NSVCD_ERROR_TIMES);
  allowance.distance = -1;
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 1, &time), NSVCD_ERROR_DISTANCE);
  allowance.pair = r.scene.pair_count;
  CHECK_EQ(nsvcd_allowed_until(r.checker, &allowance, &motion, 1, &time), NSVCD_ERROR_PAIR);
  free(r.memory);
}

static void allowances_are_checked(void) {
  static robot r;
  const double start[5] = {0, 0, 0, 0, 0};
  const double endless[5] = {0, 0, HUGE_VAL, 0, 0};
  nsvcd_allowance allowance = {0, start, HELD};
  nsvcd_checker *checker;
  taker_make(&r);
  robot_open(&r);
  const size_t size = nsvcd_checker_size(&r.scene) + 64;
  r.scene.allowance_count = 1;
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), NSVCD_ERROR_ARGUMENT);
  r.scene.allowances = &allowance;
  allowance.pair = r.scene.pair_count;
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), NSVCD_ERROR_PAIR);
  allowance.pair = 0;
  allowance.joints = NULL;
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), NSVCD_ERROR_ARGUMENT);
  allowance.joints = endless;
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), NSVCD_ERROR_VALUE);
  allowance.joints = start;
  allowance.distance = -1;
  CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), NSVCD_ERROR_DISTANCE);
  CHECK_EQ(nsvcd_checker_size(&r.scene), 0);
  free(r.memory);
}

void test_allowances(void) {
  RUN(a_box_is_taken_from_a_table);
  RUN(nothing_touches_farther_away);
  RUN(routes_take_and_put_down);
  RUN(allowed_until_it_is_too_far);
  RUN(allowances_are_checked);
}

CHECK_ALONE(test_allowances)
