// Goals as poses of a tool: what is found is at the target, by matrices, within the limits, far enough
// apart and sorted; what is there is found; what is not is told by how much.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "check.h"
#include "robot_scene.h"

void test_reach(void);

#define MOST_FOUND 16
#define HALF_TURN 3.141592653589793

// A question, and what is said to it.
typedef struct asked_reach {
  nsvcd_reach_problem problem;
  nsvcd_reach_options options;
  nsvcd_reach_answer answer;
  double start[NSVCD_MAX_JOINTS];
  double out[MOST_FOUND * NSVCD_MAX_JOINTS];
} asked_reach;

static void reach_begin(asked_reach *a, uint32_t link) {
  memset(a, 0, sizeof *a);
  a->problem.start = a->start;
  a->problem.link = link;
  a->problem.tool.rotation[3] = 1;
  a->problem.target.rotation[3] = 1;
}

// How far the tool is off: metres off the box, and radians.
static void reach_off(const nsvcd_scene *scene, const nsvcd_reach_problem *p, const double *q,
                      double *position, double *angle) {
  placed tool = placed_link(scene, p->link, q);
  placed target = placed_link(scene, p->target_link, q);
  double off[3], in[3], m[9], axis[3], turned[3], across[3];
  placed_by_pose(&tool, &p->tool);
  placed_by_pose(&target, &p->target);
  oracle_sub(tool.p, target.p, off);
  oracle_rotate_back(target.m, off, in);
  for (int k = 0; k < 3; k++) in[k] = fmax(fabs(in[k]) - (double)p->half[k], 0);
  *position = oracle_length(in);
  for (int i = 0; i < 9; i++) {
    m[i] = 0;
    for (int k = 0; k < 3; k++) m[i] += target.m[3 * k + i / 3] * tool.m[3 * k + i % 3];
  }
  for (int k = 0; k < 3; k++) axis[k] = (double)p->free_axis[k];
  const double length = oracle_length(axis);
  if (length > 0) {
    for (int k = 0; k < 3; k++) axis[k] /= length;
    oracle_rotate(m, axis, turned);
    oracle_cross(axis, turned, across);
    *angle = atan2(oracle_length(across), oracle_dot(axis, turned));
    return;
  }
  const double v[3] = {m[7] - m[5], m[2] - m[6], m[3] - m[1]};
  *angle = atan2(oracle_length(v), m[0] + m[4] + m[8] - 1);
}

static double reach_distance(const double *a, const double *b, size_t joints) {
  double sum = 0;
  for (size_t j = 0; j < joints; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sqrt(sum);
}

// Does a joint move one of two links, but not both?
static int reach_moves(const nsvcd_scene *scene, const nsvcd_reach_problem *p, size_t joint) {
  int moves = 0;
  for (uint32_t l = p->link; l; l = scene->joints[l - 1].parent) moves ^= l == joint + 1;
  for (uint32_t l = p->target_link; l; l = scene->joints[l - 1].parent) moves ^= l == joint + 1;
  return moves;
}

// Asks, and looks at all that is promised of the answer. Returns the number of solutions.
static size_t reach_ask(robot *r, asked_reach *a) {
  const nsvcd_scene *scene = &r->scene;
  const size_t joints = scene->joint_count;
  const nsvcd_reach_answer *answer = &a->answer;
  const nsvcd_reach_options *o = &a->options;
  const double tolerances[2] = {o->position_tolerance > 0 ? o->position_tolerance : 1e-6,
                                o->angle_tolerance > 0 ? o->angle_tolerance : 1e-6};
  double position, angle;
  double last = 0;
  double start[NSVCD_MAX_JOINTS];
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &r->joints[j];
    start[j] = a->start[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    start[j] = fmax(joint->low, fmin(joint->high, start[j]));
  }
  CHECK_EQ(nsvcd_reach(r->checker, &a->problem, o, a->out, MOST_FOUND, &a->answer), NSVCD_OK);
  CHECK_LE(answer->solutions, MOST_FOUND);
  CHECK_LE(answer->starts, o->starts ? o->starts : 200);
  CHECK_LE(answer->solutions + answer->touching, answer->reached);
  CHECK_LE(answer->reached, answer->starts);
  for (size_t n = 0; n < answer->solutions; n++) {
    const double *q = a->out + n * joints;
    for (size_t j = 0; j < joints; j++) {
      const nsvcd_joint *joint = &r->joints[j];
      const double turns = fabs(q[j] - start[j]) / (2 * HALF_TURN);
      const int is_far = fabs(start[j]) > 1e6 - 4;
      if (!reach_moves(scene, &a->problem, j)) CHECK_EQ(q[j], start[j]);
      if (joint->kind == NSVCD_JOINT_CONTINUOUS) CHECK_LE(turns, is_far ? 1 : 0.5 + 1e-9);
      CHECK_LE(fabs(q[j]), 1e6);
      if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
      CHECK(q[j] >= joint->low && q[j] <= joint->high);
      // no whole turn brings it nearer
      const double back = q[j] > start[j] ? q[j] - 2 * HALF_TURN : q[j] + 2 * HALF_TURN;
      if (joint->kind == NSVCD_JOINT_REVOLUTE && turns > 0.5 + 1e-9)
        CHECK(back < joint->low || back > joint->high);
    }
    reach_off(scene, &a->problem, q, &position, &angle);
    CHECK_LE(position, tolerances[0] + 1e-11);
    CHECK_LE(angle, tolerances[1] + 1e-11);
    for (size_t i = 0; i < n; i++)
      CHECK_GE(reach_distance(q, a->out + i * joints, joints), o->apart > 0 ? o->apart : 0.1);
    const double distance = reach_distance(q, start, joints);
    CHECK_LE(last, distance);
    last = distance;
    if (n == 0) CHECK_EQ(memcmp(q, answer->best, joints * sizeof *q), 0);
    if (o->may_touch) continue;
    const nsvcd_joint_motion still = {0, 0, q, NULL};
    nsvcd_check_options check_options;
    nsvcd_check_answer found;
    memset(&check_options, 0, sizeof check_options);
    check_options.clearance = o->clearance;
    CHECK_EQ(nsvcd_check(r->checker, &still, &check_options, &found), NSVCD_OK);
    CHECK(found.verdict == NSVCD_FREE && found.joint == NSVCD_NONE);
  }
  reach_off(scene, &a->problem, answer->best, &position, &angle);
  CHECK_NEAR(position, answer->position_error, 1e-11);
  CHECK_NEAR(angle, answer->angle_error, 1e-7);
  if (answer->reached) CHECK(position < tolerances[0] + 1e-11 && angle < tolerances[1] + 1e-11);
  return answer->solutions;
}

// The target is where the tool is in a configuration.
static void reach_aim(const robot *r, asked_reach *a, const double *q) {
  placed tool = placed_link(&r->scene, a->problem.link, q);
  const placed base = placed_link(&r->scene, a->problem.target_link, q);
  placed seen;
  double off[3];
  placed_by_pose(&tool, &a->problem.tool);
  oracle_sub(tool.p, base.p, off);
  oracle_rotate_back(base.m, off, seen.p);
  for (int i = 0; i < 9; i++) {
    seen.m[i] = 0;
    for (int k = 0; k < 3; k++) seen.m[i] += base.m[3 * k + i / 3] * tool.m[3 * k + i % 3];
  }
  const oracle_pose pose = oracle_of(&seen);
  a->problem.target = pose_rounded(&pose);
}

static void reach_draw(const robot *r, shapes_rng *rng, double *q) {
  for (size_t j = 0; j < r->scene.joint_count; j++) {
    const nsvcd_joint *joint = &r->joints[j];
    const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
    q[j] = is_endless ? shapes_uniform(rng, -HALF_TURN, HALF_TURN)
                      : shapes_uniform(rng, joint->low, joint->high);
  }
}

// ---- robots without bodies

static nsvcd_joint *reach_joint(robot *r, double x, double y, double z, double roll) {
  nsvcd_joint *joint = &r->joints[r->scene.joint_count];
  joint->parent = (uint32_t)r->scene.joint_count++;
  joint->origin.position[0] = (float)x;
  joint->origin.position[1] = (float)y;
  joint->origin.position[2] = (float)z;
  joint->origin.rotation[0] = (float)sin(0.5 * roll);
  joint->origin.rotation[3] = (float)cos(0.5 * roll);
  joint->axis[2] = 1;
  return joint;
}

// Of the proportions of a UR5, whose joints turn once either way; its last three axes do not meet.
static void reach_arm_of_six(robot *r) {
  static const double at[6][4] = {{0, 0, 0.089, 0},      {0, 0, 0, 0.5},      {-0.425, 0, 0, 0},
                                  {-0.392, 0, 0.109, 0}, {0, -0.095, 0, 0.5}, {0, 0.082, 0, -0.5}};
  memset(r, 0, sizeof *r);
  for (int i = 0; i < 6; i++) {
    nsvcd_joint *joint = reach_joint(r, at[i][0], at[i][1], at[i][2], at[i][3] * HALF_TURN);
    joint->high = i == 2 ? HALF_TURN : 2 * HALF_TURN;
    joint->low = -joint->high;
  }
  robot_open(r);
}

// Of the proportions of a Panda: seven joints, with their limits.
static void reach_arm_of_seven(robot *r) {
  static const double at[7][4] = {
      {0, 0, 0.333, 0},          {0, 0, 0, -0.5}, {0, -0.316, 0, 0.5}, {0.0825, 0, 0, 0.5},
      {-0.0825, 0.384, 0, -0.5}, {0, 0, 0, 0.5},  {0.088, 0, 0, 0.5}};
  static const double limits[7][2] = {{-2.8973, 2.8973},  {-1.7628, 1.7628}, {-2.8973, 2.8973},
                                      {-3.0718, -0.0698}, {-2.8973, 2.8973}, {-0.0175, 3.7525},
                                      {-2.8973, 2.8973}};
  memset(r, 0, sizeof *r);
  for (int i = 0; i < 7; i++) {
    nsvcd_joint *joint = reach_joint(r, at[i][0], at[i][1], at[i][2], at[i][3] * HALF_TURN);
    joint->low = limits[i][0];
    joint->high = limits[i][1];
  }
  robot_open(r);
}

// A chain of so many joints of all kinds, in a tree with as many others, all at random; lengths are
// in `unit`.
static uint32_t reach_tree(robot *r, shapes_rng *rng, size_t joints, double unit) {
  uint32_t last = 0;
  size_t left = joints;
  memset(r, 0, sizeof *r);
  while (left > 0 && r->scene.joint_count < NSVCD_MAX_JOINTS) {
    const size_t i = r->scene.joint_count++;
    const int is_way = i + left >= 2 * joints || shapes_pick(rng, 2);
    const int kind = shapes_pick(rng, 5);
    double axis[3];
    nsvcd_joint *joint = &r->joints[i];
    joint->kind = kind > 2 ? NSVCD_JOINT_REVOLUTE : (nsvcd_joint_kind)kind;
    joint->parent = is_way ? last : (uint32_t)shapes_pick(rng, (int)i + 1);
    joint->origin = robot_pose(rng, unit * shapes_uniform(rng, 0, 0.5));
    shapes_direction(rng, axis);
    for (int k = 0; k < 3; k++) joint->axis[k] = (float)(axis[k] * (1 + kind));
    const double scale = joint->kind == NSVCD_JOINT_PRISMATIC ? 0.3 * unit : 2;
    joint->low = shapes_uniform(rng, -1.5, 0) * scale;
    joint->high = joint->low + shapes_uniform(rng, 0.5, 1.5) * scale;
    if (is_way) last = (uint32_t)i + 1;
    left -= (size_t)is_way;
  }
  robot_open(r);
  return last;
}

// Trees of all kinds of joints, of 3 to 12 on the way to the tool: what one configuration reaches is
// reached, nearly always, and by solutions that are ones.
static void reach_finds_what_there_is(void) {
  static const size_t counts[4] = {3, 6, 7, 12};
  static robot r;
  static asked_reach a;
  shapes_rng rng = {701};
  for (int n = 0; n < 4; n++) {
    const size_t trials = check_many(300);
    size_t found = 0;
    size_t all = 0;
    for (size_t trial = 0; trial < trials; trial++) {
      double q[NSVCD_MAX_JOINTS];
      const double unit = trial % 4 ? 1 : trial % 8 ? 0.02 : 50;
      reach_begin(&a, reach_tree(&r, &rng, counts[n], unit));
      reach_draw(&r, &rng, q);
      reach_draw(&r, &rng, a.start);
      a.problem.tool = robot_pose(&rng, unit * shapes_uniform(&rng, 0, 0.3));
      reach_aim(&r, &a, q);
      a.options.seed = trial;
      // a target is a float
      if (unit > 1) a.options.position_tolerance = 2e-5;
      const size_t solutions = reach_ask(&r, &a);
      found += solutions > 0;
      all += solutions;
      free(r.memory);
    }
    printf("  %zu joints: %zu of %zu, solutions each: %.1f\n", counts[n], found, trials,
           (double)all / (double)trials);
    CHECK_GE(1000 * found, 995 * trials);
  }
}

// Arms as they are sold: how many are found, and how long that takes.
static void reach_arms(void) {
  static robot r;
  static asked_reach a;
  shapes_rng rng = {702};
  for (int arm = 0; arm < 2; arm++) {
    const size_t trials = check_many(1000);
    size_t found[2] = {0, 0};
    double taken[2] = {0, 0};
    size_t all = 0;
    (arm ? reach_arm_of_seven : reach_arm_of_six)(&r);
    for (size_t trial = 0; trial < trials; trial++) {
      double q[NSVCD_MAX_JOINTS];
      reach_begin(&a, (uint32_t)r.scene.joint_count);
      a.problem.tool.position[2] = 0.1f;
      reach_draw(&r, &rng, q);
      reach_draw(&r, &rng, a.start);
      reach_aim(&r, &a, q);
      a.options.seed = trial;
      for (size_t k = 0; k < 2; k++) {
        const clock_t began = clock();
        CHECK_EQ(
            nsvcd_reach(r.checker, &a.problem, &a.options, a.out, k ? MOST_FOUND : 1, &a.answer),
            NSVCD_OK);
        taken[k] += (double)(clock() - began) / CLOCKS_PER_SEC;
        found[k] += a.answer.solutions > 0;
        all += k ? a.answer.solutions : 0;
      }
      if (trial < 50) reach_ask(&r, &a);
    }
    printf(
        "  %d joints: %zu of %zu; %.0f us for one, %.0f us for up to %d, of which there are %.1f\n",
        arm ? 7 : 6, found[0], trials, 1e6 * taken[0] / (double)trials,
        1e6 * taken[1] / (double)trials, MOST_FOUND, (double)all / (double)trials);
    for (int k = 0; k < 2; k++) CHECK_GE(1000 * found[k], 999 * trials);
    free(r.memory);
  }
}

// Where all joints are at one of their limits, or the arm is stretched out, there is often only this
// solution, and the Jacobian is singular.
static void reach_at_limits_and_stretched_out(void) {
  static robot r;
  static asked_reach a;
  shapes_rng rng = {703};
  size_t found[2] = {0, 0};
  const size_t trials = check_many(300);
  for (size_t trial = 0; trial < trials; trial++) {
    double q[NSVCD_MAX_JOINTS];
    reach_begin(&a, reach_tree(&r, &rng, 6, 1));
    reach_draw(&r, &rng, a.start);
    reach_draw(&r, &rng, q);
    for (size_t j = 0; j < r.scene.joint_count; j++)
      if (r.joints[j].kind != NSVCD_JOINT_CONTINUOUS && shapes_pick(&rng, 4))
        q[j] = shapes_pick(&rng, 2) ? r.joints[j].low : r.joints[j].high;
    reach_aim(&r, &a, q);
    found[0] += reach_ask(&r, &a) > 0;
    free(r.memory);
    // straight: shoulder, elbow and wrist in a line, and the wrist's axes as well
    reach_arm_of_six(&r);
    reach_begin(&a, 6);
    reach_draw(&r, &rng, a.start);
    reach_draw(&r, &rng, q);
    q[2] = 0;
    if (trial % 2) q[4] = 0;
    reach_aim(&r, &a, q);
    found[1] += reach_ask(&r, &a) > 0;
    free(r.memory);
  }
  printf("  at limits %zu, stretched out %zu of %zu\n", found[0], found[1], trials);
  CHECK_GE(100 * found[0], 98 * trials);
  CHECK_GE(100 * found[1], 99 * trials);
}

// An axis about which the tool may turn, and a box it may be in: what is found is there, more is found
// than without, and arms of five joints are enough.
static void reach_regions(void) {
  static robot r;
  static asked_reach a;
  shapes_rng rng = {704};
  size_t found = 0;
  size_t turned = 0;
  const size_t trials = check_many(300);
  for (size_t trial = 0; trial < trials; trial++) {
    double q[NSVCD_MAX_JOINTS], position, angle;
    const int is_boxed = trial % 3 != 1;
    const int is_free = trial % 3 != 0;
    reach_begin(&a, reach_tree(&r, &rng, is_free ? 5 : 6, 1));
    reach_draw(&r, &rng, q);
    reach_draw(&r, &rng, a.start);
    a.problem.tool = robot_pose(&rng, 0.2);
    reach_aim(&r, &a, q);
    nsvcd_reach_problem fixed = a.problem;
    for (int k = 0; k < 3 && is_free; k++)
      a.problem.free_axis[k] =
          (float)(k == (int)(trial / 3 % 3) ? 1 + trial % 2 : 0.3 * (trial % 2));
    for (int k = 0; k < 3 && is_boxed; k++) {
      a.problem.half[k] = (float)shapes_uniform(&rng, 0, 0.1);
      // somewhere in the box, whose axes the target says
      if (!is_free) a.problem.target.position[k] += 0.5f * a.problem.half[k];
    }
    found += reach_ask(&r, &a) > 0;
    for (size_t n = 0; n < a.answer.solutions; n++) {
      reach_off(&r.scene, &fixed, a.out + n * r.scene.joint_count, &position, &angle);
      turned += is_free ? angle > 0.1 : position > 1e-3;
    }
    free(r.memory);
  }
  printf("  regions: %zu of %zu, elsewhere in them %zu\n", found, trials, turned);
  CHECK_GE(100 * found, 98 * trials);
  CHECK_GE(turned, trials);
}

// From one arm to another: a hand to a hand, on a base that both turn with.
static void reach_another_link(void) {
  static robot r;
  static asked_reach a;
  shapes_rng rng = {705};
  size_t found = 0;
  for (int trial = 0; trial < 100; trial++) {
    double q[NSVCD_MAX_JOINTS];
    memset(&r, 0, sizeof r);
    for (int i = 0; i < 9; i++) {
      nsvcd_joint *joint = reach_joint(&r, 0, 0, 0, 0);
      double axis[3];
      joint->origin = robot_pose(&rng, 0.3);
      shapes_direction(&rng, axis);
      for (int k = 0; k < 3; k++) joint->axis[k] = (float)axis[k];
      joint->low = -2;
      joint->high = 2;
      if (i == 5) joint->parent = 1;
    }
    robot_open(&r);
    reach_begin(&a, trial % 2 ? 9 : 5);
    a.problem.target_link = trial % 2 ? 5 : 9;
    a.problem.tool = robot_pose(&rng, 0.2);
    reach_draw(&r, &rng, q);
    reach_draw(&r, &rng, a.start);
    reach_aim(&r, &a, q);
    found += reach_ask(&r, &a) > 0;
    // the world, as seen from the hand
    a.problem.target_link = a.problem.link;
    a.problem.link = 0;
    reach_aim(&r, &a, q);
    (void)reach_ask(&r, &a);
    free(r.memory);
  }
  CHECK_GE(found, 98);
}

// Of what is out of reach, how far: known from the lengths.
static void reach_tells_by_how_much(void) {
  static robot r;
  static asked_reach a;
  // two links of 1 m, and a third in the hand, in a plane: the target is 4 m away in its direction
  memset(&r, 0, sizeof r);
  for (int i = 0; i < 3; i++) {
    nsvcd_joint *joint = reach_joint(&r, i ? 1 : 0, 0, 0, 0);
    joint->low = -3;
    joint->high = 3;
  }
  robot_open(&r);
  reach_begin(&a, 3);
  a.problem.tool.position[0] = 1;
  for (int turn = 0; turn < 3; turn++) {
    const double angle = turn;
    a.start[0] = -1;
    a.problem.target.position[0] = (float)(4 * cos(angle));
    a.problem.target.position[1] = (float)(4 * sin(angle));
    a.problem.target.rotation[2] = (float)sin(0.5 * angle);
    a.problem.target.rotation[3] = (float)cos(0.5 * angle);
    CHECK_EQ(reach_ask(&r, &a), 0);
    CHECK(a.answer.reached == 0 && a.answer.starts == 200 && a.answer.touching == 0);
    CHECK_NEAR(a.answer.position_error, 1, 1e-6);
    CHECK_LE(a.answer.angle_error, 1e-3);
    // one start is enough for that, if it is on the right way
    a.options.starts = 1;
    a.start[0] = angle + 0.4;
    CHECK_EQ(reach_ask(&r, &a), 0);
    CHECK_NEAR(a.answer.position_error, 1, 1e-6);
    a.options.starts = 0;
    // half a metre of it is in the box
    a.problem.half[0] = 0.5f;
    CHECK_EQ(reach_ask(&r, &a), 0);
    CHECK_NEAR(a.answer.position_error, 0.5, 1e-6);
    a.problem.half[0] = 1.0001f;
    CHECK_GE(reach_ask(&r, &a), 1);
    a.problem.half[0] = 0;
  }
  free(r.memory);
  // a wrist that turns by 1 at most, and a rail
  memset(&r, 0, sizeof r);
  for (int i = 0; i < 2; i++) {
    nsvcd_joint *joint = reach_joint(&r, 0, 0, 0, 0);
    joint->kind = i ? NSVCD_JOINT_REVOLUTE : NSVCD_JOINT_PRISMATIC;
    joint->low = -1;
    joint->high = 1;
  }
  robot_open(&r);
  reach_begin(&a, 2);
  a.problem.target.position[2] = 1.75f;
  a.problem.target.rotation[2] = (float)sin(0.5 * 1.5);
  a.problem.target.rotation[3] = (float)cos(0.5 * 1.5);
  CHECK_EQ(reach_ask(&r, &a), 0);
  CHECK_NEAR(a.answer.position_error, 0.75, 1e-9);
  CHECK_NEAR(a.answer.angle_error, 0.5, 1e-6);
  CHECK(!(a.answer.best[0] < 1) && !(a.answer.best[1] < 1));
  // tolerances are kept, each by itself
  a.options.position_tolerance = 0.8;
  CHECK_EQ(reach_ask(&r, &a), 0);
  a.options.angle_tolerance = 0.51;
  CHECK_EQ(reach_ask(&r, &a), 1);
  a.options.position_tolerance = 0.7;
  CHECK_EQ(reach_ask(&r, &a), 0);
  free(r.memory);
}

// Joints that turn without limits, or more than once: the value nearest to the start. One that is
// given out of its limits starts at them.
static void reach_takes_the_nearest_turn(void) {
  static robot r;
  static asked_reach a;
  shapes_rng rng = {706};
  memset(&r, 0, sizeof r);
  for (int i = 0; i < 2; i++) {
    nsvcd_joint *joint = reach_joint(&r, 0, 0, 0, 0);
    joint->kind = i ? NSVCD_JOINT_CONTINUOUS : NSVCD_JOINT_REVOLUTE;
    joint->origin = robot_pose(&rng, 0.3);
    joint->low = -7;
    joint->high = 11;
  }
  robot_open(&r);
  for (int trial = 0; trial < 500; trial++) {
    reach_begin(&a, 2);
    a.problem.tool.position[0] = 0.2f;
    a.problem.tool.position[1] = 0.1f;
    const double q[2] = {shapes_uniform(&rng, -7, 11), shapes_uniform(&rng, -3, 3)};
    a.start[0] = shapes_uniform(&rng, -12, 16);
    a.start[1] = trial % 5 ? shapes_uniform(&rng, -40, 40) : shapes_uniform(&rng, 9.99999e5, 1e6);
    if (trial % 10 == 0) a.start[1] = -a.start[1];
    reach_aim(&r, &a, q);
    CHECK_GE(reach_ask(&r, &a), 1);
    // wherever whole turns may bring it within 11 of -7
    const double near0 = fmax(-7, fmin(11, a.start[0]));
    CHECK_LE(fabs(a.out[0] - near0), 2 * HALF_TURN);
  }
  free(r.memory);
}

// Among boxes: solutions are free; those that are not are counted, and one of them is told.
static void reach_is_free(void) {
  static robot r;
  static asked_reach a, any;
  shapes_rng rng = {707};
  size_t free_count = 0;
  size_t touching = 0;
  size_t none = 0;
  for (int trial = 0; trial < 40; trial++) {
    robot_arm(&r, &rng, 24);
    for (int n = 0; n < 4; n++) {
      double q[NSVCD_MAX_JOINTS];
      reach_begin(&a, 6);
      reach_draw(&r, &rng, q);
      reach_draw(&r, &rng, a.start);
      a.problem.tool.position[2] = 0.15f;
      reach_aim(&r, &a, q);
      a.options.clearance = n % 2 ? 0.01f : 0;
      a.options.starts = 60;
      any = a;
      any.problem.start = any.start;
      any.options.may_touch = 1;
      free_count += reach_ask(&r, &a);
      (void)reach_ask(&r, &any);
      touching += a.answer.touching > 0;
      CHECK_EQ(any.answer.touching, 0);
      CHECK_GE(any.answer.solutions + (any.answer.solutions == MOST_FOUND), a.answer.solutions);
      if (a.answer.solutions > 0 || !a.answer.reached) continue;
      none++;
      // the one that is told is nearest to the start of those that touch, and does
      nsvcd_check_answer found;
      nsvcd_check_options options;
      const nsvcd_joint_motion still = {0, 0, a.answer.best, NULL};
      memset(&options, 0, sizeof options);
      options.clearance = a.options.clearance;
      CHECK_EQ(a.answer.touching, a.answer.reached);
      CHECK_EQ(nsvcd_check(r.checker, &still, &options, &found), NSVCD_OK);
      CHECK(found.verdict != NSVCD_FREE && a.answer.check.verdict == found.verdict);
      CHECK_LE(a.answer.check.pair, r.scene.pair_count - 1);
      CHECK_NEAR(reach_distance(a.answer.best, a.start, 6), reach_distance(any.out, a.start, 6),
                 1e-6);
    }
    free(r.memory);
  }
  printf("  free %zu, some touch %zu times, all %zu times\n", free_count, touching, none);
  CHECK(free_count > 50 && touching > 50 && none > 10);
}

// As many as there is room for end the search; the same seed gives the same, another seed others, and
// more starts nothing less near.
static void reach_is_the_same_again(void) {
  static robot r;
  static asked_reach a, b;
  shapes_rng rng = {708};
  size_t differ = 0;
  reach_arm_of_seven(&r);
  for (int trial = 0; trial < 50; trial++) {
    double q[NSVCD_MAX_JOINTS];
    reach_begin(&a, 7);
    reach_draw(&r, &rng, q);
    reach_draw(&r, &rng, a.start);
    reach_aim(&r, &a, q);
    a.options.starts = 20;
    b = a;
    b.problem.start = b.start;
    CHECK_EQ(reach_ask(&r, &a), reach_ask(&r, &b));
    CHECK_EQ(memcmp(a.out, b.out, sizeof a.out), 0);
    CHECK_EQ(memcmp(&a.answer, &b.answer, sizeof a.answer), 0);
    b.options.starts = 60;
    CHECK_GE(reach_ask(&r, &b) + 1, a.answer.solutions);
    if (a.answer.solutions && b.answer.solutions)
      CHECK_LE(reach_distance(b.out, a.start, 7), reach_distance(a.out, a.start, 7));
    b.options.starts = 20;
    b.options.seed = 1;
    (void)reach_ask(&r, &b);
    differ += memcmp(a.out, b.out, sizeof a.out) != 0;
    nsvcd_reach_answer few;
    double out[3 * 7 + 1];
    out[21] = 77;
    CHECK_EQ(nsvcd_reach(r.checker, &a.problem, &a.options, out, 3, &few), NSVCD_OK);
    CHECK(few.solutions <= 3 && few.starts <= a.answer.starts);
    CHECK_EQ(out[21], 77);
    // they may lie farther apart
    a.options.apart = 1.5;
    (void)reach_ask(&r, &a);
  }
  CHECK_GE(differ, 40);
  free(r.memory);
}

// Ends after so many calls: user is an int.
static int reach_stop(void *user) {
  return --*(int *)user < 0;
}
static void reach_stops(void) {
  static robot r;
  static asked_reach a;
  shapes_rng rng = {709};
  robot_arm(&r, &rng, 8);
  for (int calls = 0; calls < 400; calls += 1 + calls / 8) {
    double q[NSVCD_MAX_JOINTS];
    int left = calls;
    reach_begin(&a, 6);
    reach_draw(&r, &rng, q);
    reach_aim(&r, &a, q);
    a.problem.stop = reach_stop;
    a.problem.user = &left;
    CHECK_LE(reach_ask(&r, &a), (size_t)calls);
    CHECK_LE(a.answer.starts, (size_t)calls);
    // else it has ended by itself
    CHECK(left < 0 || a.answer.starts >= 25);
  }
  free(r.memory);
}

static void reach_refuses(void) {
  static robot r;
  static asked_reach good, a;
  const double not_lengths[3] = {-1, NAN, HUGE_VAL};
  reach_arm_of_six(&r);
  reach_begin(&good, 6);
  good.answer.starts = 77;
  a = good;
  a.problem.start = a.start;
#define REFUSED(change, code)                                                                     \
  do {                                                                                            \
    const asked_reach was = a;                                                                    \
    change;                                                                                       \
    CHECK_EQ(nsvcd_reach(r.checker, &a.problem, &a.options, a.out, MOST_FOUND, &a.answer), code); \
    CHECK_EQ(a.answer.starts, 77);                                                                \
    a = was;                                                                                      \
  } while (0)
  REFUSED(a.problem.start = NULL, NSVCD_ERROR_ARGUMENT);
  REFUSED(a.start[3] = NAN, NSVCD_ERROR_VALUE);
  REFUSED(a.start[3] = 2e6, NSVCD_ERROR_VALUE);
  REFUSED(a.problem.link = 7, NSVCD_ERROR_LINK);
  REFUSED(a.problem.link = 0, NSVCD_ERROR_LINK);
  REFUSED(a.problem.target_link = 7, NSVCD_ERROR_LINK);
  REFUSED(a.problem.target_link = 6, NSVCD_ERROR_LINK);
  REFUSED(a.problem.tool.rotation[0] = 1, NSVCD_ERROR_QUATERNION);
  REFUSED(a.problem.tool.position[0] = NAN, NSVCD_ERROR_POSE);
  REFUSED(a.problem.target.rotation[3] = 0, NSVCD_ERROR_QUATERNION);
  REFUSED(a.problem.target.position[2] = 2e6f, NSVCD_ERROR_POSE);
  REFUSED(a.problem.half[1] = -1e-3f, NSVCD_ERROR_RADIUS);
  REFUSED(a.problem.half[2] = NAN, NSVCD_ERROR_RADIUS);
  REFUSED(a.problem.free_axis[0] = NAN, NSVCD_ERROR_AXIS);
  for (int k = 0; k < 3; k++) {
    REFUSED(a.options.position_tolerance = not_lengths[k], NSVCD_ERROR_TOLERANCE);
    REFUSED(a.options.angle_tolerance = not_lengths[k], NSVCD_ERROR_TOLERANCE);
    REFUSED(a.options.apart = not_lengths[k], NSVCD_ERROR_DISTANCE);
    REFUSED(a.options.clearance = (float)not_lengths[k], NSVCD_ERROR_CLEARANCE);
  }
#undef REFUSED
  CHECK_EQ(nsvcd_reach(NULL, &a.problem, NULL, a.out, 1, &a.answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_reach(r.checker, NULL, NULL, a.out, 1, &a.answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_reach(r.checker, &a.problem, NULL, NULL, 1, &a.answer), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_reach(r.checker, &a.problem, NULL, a.out, 1, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_reach(r.checker, &a.problem, NULL, a.out, 0, &a.answer), NSVCD_ERROR_COUNT);
  CHECK_EQ(a.answer.starts, 77);
  free(r.memory);
  // joints that go on for a million metres, and turns for as many radians, are joints
  shapes_rng rng = {710};
  memset(&r, 0, sizeof r);
  for (int i = 0; i < 6; i++) {
    nsvcd_joint *joint = reach_joint(&r, 0, 0, 0, 0);
    joint->kind = i < 3 ? NSVCD_JOINT_PRISMATIC : NSVCD_JOINT_REVOLUTE;
    joint->axis[2] = i % 3 == 2;
    joint->axis[i % 3] = 1;
    joint->low = -1e6;
    joint->high = 1e6;
  }
  robot_open(&r);
  for (int trial = 0; trial < 50; trial++) {
    reach_begin(&a, 6);
    a.problem.tool = robot_pose(&rng, 0.1);
    a.problem.target = robot_pose(&rng, trial % 2 ? 3 : 1000);
    CHECK_GE(reach_ask(&r, &a), 1);
  }
  free(r.memory);
}

void test_reach(void) {
  RUN(reach_finds_what_there_is);
  RUN(reach_arms);
  RUN(reach_at_limits_and_stretched_out);
  RUN(reach_regions);
  RUN(reach_another_link);
  RUN(reach_tells_by_how_much);
  RUN(reach_takes_the_nearest_turn);
  RUN(reach_is_free);
  RUN(reach_is_the_same_again);
  RUN(reach_stops);
  RUN(reach_refuses);
}

CHECK_ALONE(test_reach)
