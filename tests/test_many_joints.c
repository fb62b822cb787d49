// Robots of many joints: a snake of as many as there may be, and a humanoid of 43. Where links are is
// computed anew, by matrices, and distances are the oracle's.
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
#define ROBOT_BALLS 16
#include "route_scene.h"
#include "../examples/verify/nsvcd_verify_robot.h"

void test_many_joints(void);

// Adds a joint at a place on a link, about the axis x, y or z, and a small box on it. Returns the
// link that it carries.
static uint32_t add_link(robot *r, uint32_t on, int axis, double x, double y, double z) {
  nsvcd_joint *joint = &r->joints[r->scene.joint_count++];
  nsvcd_part *part = &r->parts[r->scene.part_count];
  const double place[3] = {x, y, z};
  joint->parent = on;
  joint->origin.rotation[3] = 1;
  for (int k = 0; k < 3; k++) joint->origin.position[k] = (float)place[k];
  joint->axis[axis] = 1;
  joint->low = -2;
  joint->high = 2;
  joint->speed = joint->acceleration = 1;
  r->shape[r->scene.part_count++] = 0;
  part->body = robot_shapes()[0].body;
  part->link = (uint32_t)r->scene.joint_count;
  part->pose.rotation[3] = 1;
  part->scale = SMALL;
  return part->link;
}

// Adds an obstacle, and pairs: of all parts of the robot whose links are three joints apart or more,
// in number, and of each with the obstacle.
static void add_obstacle(robot *r, double x, double y, double z) {
  const uint32_t obstacle = (uint32_t)r->scene.part_count++;
  nsvcd_part *part = &r->parts[obstacle];
  part->body = robot_shapes()[0].body;
  part->pose.rotation[3] = 1;
  part->pose.position[0] = (float)x;
  part->pose.position[1] = (float)y;
  part->pose.position[2] = (float)z;
  for (uint32_t a = 0; a < obstacle; a++) {
    for (uint32_t b = a + 3; b <= obstacle; b++) {
      const nsvcd_body_pair pair = {a, b};
      r->pairs[r->scene.pair_count++] = pair;
    }
  }
}

static double size_apart(const robot *r, const double *q) {
  double least = 1;
  for (size_t p = 0; p < r->scene.pair_count; p++)
    least = fmin(least, robot_apart(r, &r->pairs[p], q, 0.02));
  return least;
}

// Plans from a start to a goal whose straight line is not free; what is found is free, at so many
// times, and what is held is never elsewhere, if only by a bit.
static void is_planned(robot *r, const double *start, const double *goal, const uint8_t *held,
                       size_t looks, int times) {
  nsvcd_route_problem problem;
  nsvcd_route_options options;
  nsvcd_route_answer answer;
  nsvcd_check_answer straight;
  const size_t joints = r->scene.joint_count;
  double line[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = {1, 1, line, NULL};
  memcpy(line, start, joints * sizeof *line);
  memcpy(line + joints, goal, joints * sizeof *line);
  CHECK_EQ(nsvcd_check(r->checker, &motion, NULL, &straight), NSVCD_OK);
  CHECK_EQ(straight.verdict, NSVCD_HIT);
  memset(&problem, 0, sizeof problem);
  memset(&options, 0, sizeof options);
  problem.start = start;
  problem.goals = goal;
  problem.goal_count = 1;
  problem.held = held;
  options.nodes = 20000;
  options.looks = looks;
  const size_t size = nsvcd_route_size(r->checker, &problem, &options);
  void *memory = calloc(1, size);
  if (!size || !memory) exit(1);
  CHECK_EQ(nsvcd_route(r->checker, &problem, &options, memory, size, &answer), NSVCD_OK);
  CHECK_EQ(answer.status, NSVCD_ROUTE_FOUND);
  if (answer.status == NSVCD_ROUTE_FOUND) {
    const nsvcd_joint_motion *m = &answer.motion;
    robot_motion_is_smooth(r, m, start, goal);
    for (size_t n = 0; n < (2 * m->pieces + 1) * joints && held; n++)
      if (held[n % joints]) CHECK_EQ(memcmp(&m->points[n], &start[n % joints], sizeof *start), 0);
    for (int k = 0; k <= times; k++) {
      double q[NSVCD_MAX_JOINTS];
      joints_at_time(m, joints, m->times[m->pieces] * k / times, q);
      CHECK_GE(size_apart(r, q), -1e-9);
    }
  }
  printf("  %zu joints, %zu pairs: a checker of %zu KB, a route in %zu KB, %zu nodes, %zu stops\n",
         joints, r->scene.pair_count, nsvcd_checker_size(&r->scene) >> 10, size >> 10, answer.nodes,
         answer.stops);
  free(memory);
}

// A snake lies along x, and an obstacle between where its tail is and where it is to be.
static void snakes_are_planned(void) {
  static robot r;
  double start[NSVCD_MAX_JOINTS] = {0}, goal[NSVCD_MAX_JOINTS] = {0};
  uint32_t on = 0;
  memset(&r, 0, sizeof r);
  for (int n = 0; n < NSVCD_MAX_JOINTS; n++) on = add_link(&r, on, 1 + n % 2, 0.05, 0, 0);
  add_obstacle(&r, 6, 0.4, 0);
  robot_open(&r);
  start[101] = -0.25;
  goal[101] = 0.6;
  is_planned(&r, start, goal, NULL, 0, 20);
  // one joint more is too many
  r.scene.joint_count++;
  CHECK_EQ(nsvcd_checker_size(&r.scene), 0);
  free(r.memory);
}

// A humanoid: a spine of three joints, arms of seven, hands of seven, legs of six.
static void humanoids_are_planned(void) {
  static robot r;
  double start[NSVCD_MAX_JOINTS] = {0}, goal[NSVCD_MAX_JOINTS] = {0};
  uint32_t chest = 0;
  size_t shoulder = 0;
  memset(&r, 0, sizeof r);
  for (int n = 0; n < 3; n++) chest = add_link(&r, chest, n, 0, 0, 0.12);
  for (int side = -1; side <= 1; side += 2) {
    uint32_t arm = chest;
    if (side > 0) shoulder = r.scene.joint_count;
    for (int n = 0; n < 7; n++)
      arm = add_link(&r, arm, n % 3, 0, n ? 0.1 * side : 0.2 * side, 0.05);
    for (int n = 0; n < 7; n++) {
      static const int on_last[7] = {0, 1, 0, 1, 0, 1, 0};
      static uint32_t finger;
      finger = add_link(&r, on_last[n] ? finger : arm, 0, on_last[n] ? 0 : 0.05 * (n - 3),
                        0.08 * side, 0);
    }
    uint32_t leg = 0;
    for (int n = 0; n < 6; n++) leg = add_link(&r, leg, n % 3, 0, n ? 0 : 0.12 * side, -0.12);
  }
  CHECK_EQ(r.scene.joint_count, 43);
  add_obstacle(&r, 0.26, 0.63, 0.6);
  robot_open(&r);
  // an arm swings from one side of it to the other, about z
  start[shoulder + 2] = -0.2;
  goal[shoulder + 2] = -1.5;
  is_planned(&r, start, goal, NULL, 0, 100);
  // by the three joints of the shoulder and the elbow alone, the chest askew
  uint8_t held[NSVCD_MAX_JOINTS];
  memset(held, 1, sizeof held);
  memset(held + shoulder, 0, 4);
  for (int n = 0; n < 3; n++) start[n] = goal[n] = 0.03 * n;
  is_planned(&r, start, goal, held, 0, 100);
  is_planned(&r, start, goal, held, NSVCD_NONE, 100);
  free(r.memory);
}

// Where the last links of long chains are, by quaternions and by matrices, differs by no more than
// is said of the rounding of frames; and so do the places that the checker of certificates has.
static void long_chains_round_little(void) {
  static robot r;
  shapes_rng rng = {128};
  double worst = 0;
  for (int trial = 0; trial < 20; trial++) {
    static double points[2 * NSVCD_MAX_JOINTS];
    const nsvcd_joint_motion motion = {1, 1, points, NULL};
    robot_random_of(&r, &rng, NSVCD_MAX_JOINTS);
    robot_open(&r);
    for (size_t j = 0; j < 2 * NSVCD_MAX_JOINTS; j++) points[j] = shapes_uniform(&rng, -250, 250);
    r.checker->times[0] = 0;
    nsvcd__sample(r.checker, &motion, 0);
    for (size_t n = 0; n < r.scene.part_count; n += 13) {
      const nsvcd__member *m = &r.checker->members[n];
      const nsvcd__dpose *frame = &r.checker->frames[m->row];
      const placed at = placed_part(&r.scene, n, points);
      const double off[3] = {at.p[0] - frame->position.x, at.p[1] - frame->position.y,
                             at.p[2] - frame->position.z};
      worst = fmax(worst, oracle_length(off) / m->rounding);
    }
    free(r.memory);
  }
  printf("  of the rounding that is allowed for, %.3f is there\n", worst);
  CHECK_LE(worst, 1);
  CHECK_EQ(NSVCD_VERIFY_JOINTS, NSVCD_MAX_JOINTS);
}

void test_many_joints(void) {
  RUN(snakes_are_planned);
  RUN(humanoids_are_planned);
  RUN(long_chains_round_little);
}
CHECK_ALONE(test_many_joints)
