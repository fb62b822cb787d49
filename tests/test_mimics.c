// test_mimics.c - joints that mimic others: a gripper whose second finger follows the first; and random
// robots of which joints drive each other.
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

void test_mimics(void);

enum { LEADER = 6, FOLLOWER, JOINTS };

// Computed here, joint by joint.
static double driven(const robot *r, size_t j, const double *q) {
  const nsvcd_joint *joint = &r->joints[j];
  return joint->mimic ? joint->multiplier * q[joint->mimic - 1] + joint->offset : q[j];
}
static void drive(const robot *r, double *q) {
  for (size_t j = 0; j < r->scene.joint_count; j++) q[j] = driven(r, j, q);
}
static double off_by(const robot *r, const double *q) {
  double most = 0;
  for (size_t j = 0; j < r->scene.joint_count; j++) most = fmax(most, fabs(q[j] - driven(r, j, q)));
  return most;
}

// An arm of six joints whose fingers slide away from each other, the second one at half the speed and
// within narrower limits; boxes about it.
static void gripper(robot *r, shapes_rng *rng, size_t boxes) {
  robot_arm(r, rng, boxes);
  free(r->memory);
  r->scene.joint_count = JOINTS;
  for (uint32_t j = LEADER; j < JOINTS; j++) {
    nsvcd_joint *joint = &r->joints[j];
    joint->kind = NSVCD_JOINT_PRISMATIC;
    joint->parent = 6;
    joint->origin.rotation[3] = 1;
    joint->origin.position[2] = 0.1f;
    joint->axis[1] = 1;
    joint->low = -0.2;
    joint->high = 0.2;
    const uint32_t n = (uint32_t)r->scene.part_count++;
    r->shape[n] = 0;
    r->parts[n].body = robot_shapes()[0].body;
    r->parts[n].link = j + 1;
    r->parts[n].scale = SMALL;
    r->parts[n].pose.rotation[3] = 1;
    for (uint32_t a = 0; a < n; a++) {
      if (r->parts[a].link >= 5) continue;
      const nsvcd_body_pair pair = {a, n};
      r->pairs[r->scene.pair_count++] = pair;
    }
  }
  r->joints[FOLLOWER].mimic = LEADER + 1;
  r->joints[FOLLOWER].multiplier = -0.5;
  r->joints[FOLLOWER].offset = -0.02;
  // so the leader is to be in -0.04..0.16
  r->joints[FOLLOWER].low = -0.1;
  r->joints[FOLLOWER].high = 0;
  for (size_t j = 0; j < JOINTS; j++) {
    r->joints[j].speed = j == FOLLOWER ? 0.02 : shapes_uniform(rng, 1, 3);
    r->joints[j].acceleration = j == FOLLOWER ? 0.05 : shapes_uniform(rng, 3, 10);
  }
  robot_open(r);
}

static int gripper_place(robot *r, shapes_rng *rng, double *q) {
  const nsvcd_joint_motion still = {0, 0, q, NULL};
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&options, 0, sizeof options);
  options.clearance = 0.01f;
  for (int n = 0; n < 200; n++) {
    for (size_t j = 0; j < LEADER; j++) q[j] = shapes_uniform(rng, -3.1, 3.1);
    q[LEADER] = shapes_uniform(rng, -0.04, 0.16);
    drive(r, q);
    CHECK_EQ(nsvcd_check(r->checker, &still, &options, &answer), NSVCD_OK);
    if (answer.verdict == NSVCD_FREE && answer.joint == NSVCD_NONE) return 1;
  }
  return 0;
}

// Routes keep the relation at all times, and the limits of both, and what is held stays.
static void routes_of_a_gripper(void) {
  static robot r;
  shapes_rng rng = {5};
  size_t found = 0;
  size_t asked = 0;
  size_t limited = 0;
  for (int trial = 0; trial < 24; trial++) {
    double rows[3][JOINTS];
    uint8_t held[JOINTS] = {0};
    nsvcd_route_problem problem;
    nsvcd_route_options options;
    nsvcd_route_answer answer;
    memset(&problem, 0, sizeof problem);
    memset(&options, 0, sizeof options);
    memset(&answer, 0, sizeof answer);
    gripper(&r, &rng, 10);
    const int is_asked = gripper_place(&r, &rng, rows[0]) && gripper_place(&r, &rng, rows[1]);
    const int is_held = trial % 4 == 1;
    // the follower's own entry does not count
    held[FOLLOWER] = trial % 4 == 2;
    held[LEADER] = (uint8_t)is_held;
    if (is_held) rows[1][LEADER] = rows[0][LEADER];
    drive(&r, rows[1]);
    problem.start = rows[0];
    problem.goals = rows[1];
    problem.goal_count = 1;
    problem.held = trial % 4 ? held : NULL;
    options.looks = trial % 2 ? 0 : NSVCD_NONE;
    options.nodes = 2000;
    options.seed = (uint64_t)trial;
    const size_t size = nsvcd_route_size(r.checker, &problem, &options);
    void *memory = malloc(size);
    CHECK(size > 0);
    CHECK_EQ(nsvcd_route(r.checker, &problem, &options, memory, size, &answer), NSVCD_OK);
    asked += (size_t)is_asked;
    if (is_asked && answer.status == NSVCD_ROUTE_FOUND) {
      const nsvcd_joint_motion *m = &answer.motion;
      found++;
      robot_motion_is_smooth(&r, m, rows[0], rows[1]);
      for (size_t k = 0; k <= m->pieces * m->degree; k++)
        CHECK(!(off_by(&r, m->points + k * JOINTS) > 0));
      double fastest = 0;
      for (int k = 0; k <= 200; k++) {
        double q[JOINTS];
        nsvcd_motion_at(m, JOINTS, answer.duration * k / 200, q);
        CHECK_LE(off_by(&r, q), 1e-12);
        for (size_t j = LEADER; j < JOINTS; j++) {
          CHECK(q[j] >= r.joints[j].low - 1e-9 && q[j] <= r.joints[j].high + 1e-9);
          if (is_held) CHECK_EQ(q[j], rows[0][j]);
        }
        for (size_t p = 0; p < r.scene.pair_count; p++)
          CHECK_GE(robot_apart(&r, &r.pairs[p], q, 0.1), -1e-9);
      }
      for (size_t p = 0; p < m->pieces; p++) {
        const double *at = m->points + 2 * p * JOINTS + FOLLOWER;
        const double time = m->times[p + 1] - m->times[p];
        fastest = fmax(fastest, 2 * fabs(at[JOINTS] - at[0]) / time);
      }
      limited += fastest > 0.019;
    }
    free(memory);
    free(r.memory);
  }
  CHECK_GE(found, 3 * asked / 4);
  CHECK_GE(asked, 20);
  CHECK_GE(limited, 1);
}

// A motion that the joints cannot make is refused, wherever it breaks the relation.
static void broken_ones_are_refused(void) {
  static robot r;
  shapes_rng rng = {6};
  double points[5][JOINTS];
  double out[JOINTS];
  const nsvcd_joint_motion motion = {2, 2, points[0], NULL};
  nsvcd_check_answer answer;
  nsvcd_route_problem problem;
  nsvcd_route_answer route;
  nsvcd_reach_problem reach;
  nsvcd_reach_answer reached;
  nsvcd_part part;
  size_t count;
  int is_found;
  gripper(&r, &rng, 3);
  memset(&problem, 0, sizeof problem);
  memset(&reach, 0, sizeof reach);
  for (size_t k = 0; k < 5; k++) {
    for (size_t j = 0; j < JOINTS; j++) points[k][j] = shapes_uniform(&rng, -0.04, 0.16);
    drive(&r, points[k]);
  }
  CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_OK);
  for (size_t k = 0; k < 5; k++) {
    for (int n = 0; n < 2; n++) {
      const double was = points[k][n ? LEADER : FOLLOWER];
      points[k][n ? LEADER : FOLLOWER] += n ? 5e-9 : -2e-9;
      CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_ERROR_MIMIC);
      points[k][n ? LEADER : FOLLOWER] = was + 5e-10;
      CHECK_EQ(nsvcd_check(r.checker, &motion, NULL, &answer), NSVCD_OK);
      points[k][n ? LEADER : FOLLOWER] = was;
    }
  }
  points[2][FOLLOWER] += 1e-6;
  const double *bad = points[2];
  CHECK_EQ(nsvcd_proximities(r.checker, bad, NULL, NULL, 0, &count), NSVCD_ERROR_MIMIC);
  CHECK_EQ(nsvcd_nearest_free(r.checker, bad, NULL, out, &is_found), NSVCD_ERROR_MIMIC);
  CHECK_EQ(nsvcd_reparent(r.checker, bad, 0, 0, &part), NSVCD_ERROR_MIMIC);
  reach.start = bad;
  reach.link = 7;
  reach.tool.rotation[3] = reach.target.rotation[3] = 1;
  CHECK_EQ(nsvcd_reach(r.checker, &reach, NULL, out, 1, &reached), NSVCD_ERROR_MIMIC);
  for (int n = 0; n < 3; n++) {
    problem.start = n == 0 ? bad : points[0];
    problem.goals = n == 1 ? points[1] : points[0];  // of two the second one
    problem.goal_count = 2;
    problem.guess = n == 2 ? bad : NULL;
    problem.guess_count = n == 2;
    CHECK_EQ(nsvcd_route_size(r.checker, &problem, NULL), 0);
    CHECK_EQ(nsvcd_route(r.checker, &problem, NULL, out, 0, &route), NSVCD_ERROR_MIMIC);
  }
  free(r.memory);
}

static void scenes_are_refused(void) {
  static robot r;
  shapes_rng rng = {7};
  gripper(&r, &rng, 0);
  const nsvcd_joint good[2] = {r.joints[LEADER], r.joints[FOLLOWER]};
  nsvcd_checker *checker;
  const size_t size = nsvcd_checker_size(&r.scene);
#define REFUSED(change, code)                                               \
  do {                                                                      \
    change;                                                                 \
    CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), code); \
    memcpy(r.joints + LEADER, good, sizeof good);                           \
  } while (0)
  nsvcd_joint *leader = &r.joints[LEADER];
  nsvcd_joint *follower = &r.joints[FOLLOWER];
  REFUSED(follower->mimic = JOINTS + 1, NSVCD_ERROR_MIMIC);
  REFUSED(follower->mimic = FOLLOWER + 1, NSVCD_ERROR_MIMIC);
  REFUSED((leader->mimic = 1, leader->multiplier = 1), NSVCD_ERROR_MIMIC);
  REFUSED(follower->multiplier = 0, NSVCD_ERROR_MIMIC);
  REFUSED(follower->multiplier = 1e-7, NSVCD_ERROR_MIMIC);
  REFUSED(follower->multiplier = NAN, NSVCD_ERROR_MIMIC);
  REFUSED(follower->multiplier = 2e6, NSVCD_ERROR_MIMIC);
  REFUSED(follower->offset = HUGE_VAL, NSVCD_ERROR_MIMIC);
  // turns of both are without end: a full one has to bring both back
  REFUSED((leader->kind = follower->kind = NSVCD_JOINT_CONTINUOUS), NSVCD_ERROR_MIMIC);
  REFUSED((leader->kind = follower->kind = NSVCD_JOINT_CONTINUOUS, follower->multiplier = -2),
          NSVCD_OK);
  REFUSED(leader->kind = NSVCD_JOINT_CONTINUOUS, NSVCD_OK);
  // nothing is left of the leader's limits
  REFUSED((follower->low = 0.1, follower->high = 0.2), NSVCD_ERROR_LIMITS);
  REFUSED((leader->low = leader->high = 0.16), NSVCD_OK);
  // a leader may come after what follows it
  REFUSED((*leader = *follower, *follower = good[0], leader->mimic = FOLLOWER + 1), NSVCD_OK);
  // what the follower allows is a limit of the leader, also of one that has none
  double q[JOINTS] = {0};
  const nsvcd_joint_motion still = {0, 0, q, NULL};
  nsvcd_check_answer answer;
  for (int n = 0; n < 2; n++) {
    leader->kind = n ? NSVCD_JOINT_CONTINUOUS : NSVCD_JOINT_PRISMATIC;
    CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &checker), NSVCD_OK);
    q[LEADER] = 0.161;
    drive(&r, q);
    CHECK_EQ(nsvcd_check(checker, &still, NULL, &answer), NSVCD_OK);
    CHECK_EQ(answer.joint, LEADER);
    q[LEADER] = 0.16;
    drive(&r, q);
    CHECK_EQ(nsvcd_check(checker, &still, NULL, &answer), NSVCD_OK);
    CHECK_EQ(answer.joint, NSVCD_NONE);
  }
  free(r.memory);
}

// A random tree of which some joints mimic others, anywhere before or after them.
static void random_mimics(robot *r, shapes_rng *rng, size_t least) {
  do robot_random(r, rng);
  while (r->scene.joint_count < least);
  const size_t joints = r->scene.joint_count;
  const uint32_t leader = (uint32_t)shapes_pick(rng, (int)joints);
  for (size_t j = 0; j < joints; j++) {
    nsvcd_joint *joint = &r->joints[j];
    joint->speed = joint->acceleration = 1;
    joint->low = -2.5;
    joint->high = 3;
    if (j == leader || (joints > 2 && shapes_pick(rng, 2))) continue;
    joint->mimic = leader + 1;
    joint->multiplier = (shapes_pick(rng, 2) ? -1 : 1) * (double)(1 + shapes_pick(rng, 2));
    if (joint->kind != NSVCD_JOINT_CONTINUOUS) joint->multiplier *= 0.6;
    joint->offset = shapes_uniform(rng, -0.5, 0.5);
  }
}

// Within the limits of leaders and followers.
static void draw_mimics(const robot *r, shapes_rng *rng, double *q) {
  for (int n = 0; n < 10000; n++) {
    int fits = 1;
    for (size_t j = 0; j < r->scene.joint_count; j++) {
      const int is_endless = r->joints[j].kind == NSVCD_JOINT_CONTINUOUS;
      q[j] = shapes_uniform(rng, is_endless ? -4 : -2.5, is_endless ? 4 : 3);
    }
    drive(r, q);
    for (size_t j = 0; j < r->scene.joint_count; j++)
      if (r->joints[j].kind != NSVCD_JOINT_CONTINUOUS)
        fits &= q[j] >= r->joints[j].low && q[j] <= r->joints[j].high;
    if (fits) return;
  }
  CHECK(0);
}

static nsvcd_range_answer range_of(const robot *r, nsvcd_body_pair pair, float clearance,
                                   size_t boxes) {
  nsvcd_range_options o;
  nsvcd_range_answer out;
  memset(&o, 0, sizeof o);
  memset(&out, 0, sizeof out);
  o.clearance = clearance;
  o.boxes = boxes;
  const size_t size = nsvcd_pair_range_size(r->checker, pair, &o);
  void *memory = malloc(size);
  CHECK(size > 0);
  CHECK_EQ(nsvcd_pair_range(r->checker, pair, &o, memory, size, &out), NSVCD_OK);
  free(memory);
  return out;
}

// What is said of all configurations holds in those that are drawn, and those named can be.
static void ranges_of_mimics(void) {
  static robot r;
  shapes_rng rng = {18};
  size_t count[4] = {0, 0, 0, 0};
  size_t fewer = 0;
  for (size_t trial = 0; trial < check_many(60); trial++) {
    random_mimics(&r, &rng, 2);
    for (size_t i = 0; i < r.scene.joint_count; i++) {
      r.parts[i].scale = 0;
      for (int k = 0; k < 3; k++) {
        r.joints[i].origin.position[k] *= trial % 2 ? 1 : 0.1f;
        if (r.shape[i] != FAR_SHAPE) r.parts[i].pose.position[k] *= trial % 2 ? 1 : 0.1f;
      }
    }
    robot_open(&r);
    for (uint32_t b = 1; b < r.scene.part_count && b < 4; b++) {
      const nsvcd_body_pair pair = {b - 1, b};
      const nsvcd_range_answer a = range_of(&r, pair, 0, 300);
      count[a.meeting]++;
      fewer += a.joints == 1 && r.joints[b].mimic && r.joints[b].parent == b;
      if (a.has_free) CHECK(robot_apart(&r, &pair, a.free, 0.1) > -1e-9);
      if (a.has_hit) CHECK(robot_apart(&r, &pair, a.hit, 0.1) < 1e-6);
      if (a.has_free) CHECK(!(off_by(&r, a.free) > 0));
      if (a.has_hit) CHECK(!(off_by(&r, a.hit) > 0));
      if (a.meeting != NSVCD_MEETS_NEVER && a.meeting != NSVCD_MEETS_ALWAYS) continue;
      for (int n = 0; n < 400; n++) {
        double q[NSVCD_MAX_JOINTS];
        draw_mimics(&r, &rng, q);
        const double apart = robot_apart(&r, &pair, q, 0.1);
        CHECK(a.meeting == NSVCD_MEETS_NEVER ? apart > 0 : apart <= 1e-9);
      }
    }
    free(r.memory);
  }
  for (int n = 1; n < 4; n++) CHECK_GE(count[n], 5);
  CHECK_GE(fewer, 5);
}

// How near two parts come in a random walk of the leaders that only goes nearer.
static double nearest_of(const robot *r, const nsvcd_body_pair *pair, shapes_rng *rng) {
  double q[NSVCD_MAX_JOINTS];
  double step = 0.5;
  for (size_t j = 0; j < r->scene.joint_count; j++)
    q[j] = shapes_uniform(rng, r->joints[j].low, r->joints[j].high);
  drive(r, q);
  double nearest = robot_apart(r, pair, q, 10);
  for (int n = 0; n < 120; n++) {
    double next[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < r->scene.joint_count; j++)
      next[j] =
          fmax(r->joints[j].low, fmin(r->joints[j].high, q[j] + step * shapes_uniform(rng, -1, 1)));
    drive(r, next);
    const double apart = robot_apart(r, pair, next, 10);
    step *= apart < nearest ? 1.2 : 0.95;
    if (!(apart < nearest)) continue;
    nearest = apart;
    memcpy(q, next, sizeof next);
  }
  return nearest;
}

// With a clearance a little above the least distance that a descent finds, never is not the answer;
// with half of it, it mostly is. A chain of which each joint turns eight times as far as one of two
// leaders, of which one does not carry the parts.
static void ranges_of_mimics_see_the_nearest(void) {
  static robot r;
  shapes_rng rng = {42};
  size_t asked = 0;
  size_t never = 0;
  for (size_t trial = 0; trial < check_many(30); trial++) {
    robot_random_of(&r, &rng, 5);
    for (uint32_t i = 0; i < 5; i++) {
      const double middle = shapes_uniform(&rng, -2, 2);
      const double half = shapes_uniform(&rng, 0.02, 0.08);
      nsvcd_joint *joint = &r.joints[i];
      joint->kind = NSVCD_JOINT_REVOLUTE;
      joint->parent = i;
      joint->low = i < 2 ? middle - half : -20;
      joint->high = i < 2 ? middle + half : 20;
      r.parts[i].scale = 0;
      if (i < 2) continue;
      joint->mimic = 1 + (uint32_t)(i % 2);
      joint->multiplier = shapes_pick(&rng, 2) ? -8 : 8;
      joint->offset = middle;
    }
    const nsvcd_body_pair pair = {0, 4};
    robot_open(&r);
    double least = 10;
    for (int n = 0; n < 10; n++) least = fmin(least, nearest_of(&r, &pair, &rng));
    if (least > 0.02) {
      asked++;
      CHECK(range_of(&r, pair, (float)(1.002 * least + 1e-5), 400).meeting != NSVCD_MEETS_NEVER);
      never += range_of(&r, pair, (float)(0.5 * least), 400).meeting == NSVCD_MEETS_NEVER;
    }
    free(r.memory);
  }
  CHECK_GE(asked, 8);
  CHECK_GE(2 * never, asked);
}

// Two boxes slide by the same, one in the other: always, and nsvcd_find_pairs sees it too. One slides
// the other way: they part.
static void what_slides_together_stays(void) {
  static robot r;
  for (int n = 0; n < 2; n++) {
    robot_bare(&r, NSVCD_JOINT_PRISMATIC, 2, 2, 1);
    for (uint32_t j = 0; j < 2; j++) {
      r.joints[j].parent = 0;
      r.joints[j].axis[0] = 1;
      r.parts[j].link = j + 1;
      r.parts[j].body = robot_shapes()[0].body;
    }
    r.joints[0].mimic = 2;
    r.joints[0].multiplier = n ? -1 : 1;
    r.joints[0].offset = 0.01;
    robot_open(&r);
    nsvcd_body_pair pairs[1];
    nsvcd_pair_counts counts;
    const nsvcd_range_answer a = range_of(&r, r.pairs[0], 0, 0);
    CHECK_EQ(a.meeting, n ? NSVCD_MEETS_SOMETIMES : NSVCD_MEETS_ALWAYS);
    CHECK_EQ(a.joints, 1);
    CHECK_EQ(nsvcd_find_pairs(r.checker, 0, 1, pairs, 1, &counts), NSVCD_OK);
    CHECK_EQ(counts.touching, !n);
    free(r.memory);
  }
}

// A tool is brought to where it is in some configuration, by followers too, and leaders that do not
// carry it.
static void reaches_of_mimics(void) {
  static robot r;
  shapes_rng rng = {19};
  size_t solved = 0;
  size_t asked = 0;
  for (size_t trial = 0; trial < check_many(120); trial++) {
    double start[NSVCD_MAX_JOINTS], q[NSVCD_MAX_JOINTS], out[8 * NSVCD_MAX_JOINTS];
    uint8_t held[NSVCD_MAX_JOINTS] = {0};
    nsvcd_reach_problem p;
    nsvcd_reach_options o;
    nsvcd_reach_answer a;
    memset(&p, 0, sizeof p);
    memset(&o, 0, sizeof o);
    random_mimics(&r, &rng, 2);
    robot_open(&r);
    const size_t joints = r.scene.joint_count;
    draw_mimics(&r, &rng, start);
    draw_mimics(&r, &rng, q);
    const size_t stays = (size_t)shapes_pick(&rng, (int)joints);
    held[stays] = trial % 2;
    q[stays] = held[stays] ? start[stays] : q[stays];
    if (held[stays] && r.joints[stays].mimic) held[stays] = 0;
    drive(&r, q);
    p.start = start;
    p.link = 1 + (uint32_t)shapes_pick(&rng, (int)joints);
    p.tool = robot_pose(&rng, 0.2);
    p.held = held;
    o.may_touch = 1;
    placed at = placed_link(&r.scene, p.link, q);
    placed_by_pose(&at, &p.tool);
    const oracle_pose pose = oracle_of(&at);
    p.target = pose_rounded(&pose);
    CHECK_EQ(nsvcd_reach(r.checker, &p, &o, out, 8, &a), NSVCD_OK);
    asked++;
    solved += a.solutions > 0;
    for (size_t n = 0; n < a.solutions; n++) {
      const double *found = out + n * joints;
      CHECK(!(off_by(&r, found) > 0));
      for (size_t j = 0; j < joints; j++) {
        const nsvcd_joint *joint = &r.joints[j];
        const int is_free = joint->kind == NSVCD_JOINT_CONTINUOUS;
        CHECK(is_free || (found[j] >= joint->low - 1e-12 && found[j] <= joint->high + 1e-12));
        if (held[j] || (joint->mimic && held[joint->mimic - 1]))
          CHECK_NEAR(found[j], start[j], 1e-12);
      }
      placed there = placed_link(&r.scene, p.link, found);
      placed_by_pose(&there, &p.tool);
      for (int k = 0; k < 3; k++) CHECK_NEAR(there.p[k], (double)p.target.position[k], 2e-6);
      for (int k = 0; k < 9; k++) CHECK_NEAR(there.m[k], at.m[k], 4e-6);
    }
    free(r.memory);
  }
  CHECK_GE(solved, 9 * asked / 10);
}

// By differences: a leader's slope is that of all it drives. And what is free near by can be.
static void slopes_and_ways_out(void) {
  static robot r;
  shapes_rng rng = {20};
  size_t compared = 0;
  size_t found = 0;
  for (size_t trial = 0; trial < check_many(150); trial++) {
    double q[NSVCD_MAX_JOINTS], out[NSVCD_MAX_JOINTS];
    nsvcd_proximity_options o;
    nsvcd_proximity near[3];
    size_t count = 0;
    int is_found = 0;
    random_mimics(&r, &rng, 2);
    r.scene.pair_count = 1;
    r.pairs[0].a = 0;
    r.pairs[0].b = (uint32_t)r.scene.joint_count - 1;
    robot_open(&r);
    draw_mimics(&r, &rng, q);
    memset(&o, 0, sizeof o);
    o.max_distance = 2;
    o.to = 1e-7f;
    CHECK_EQ(nsvcd_proximities(r.checker, q, &o, near, 1, &count), NSVCD_OK);
    for (size_t j = 0; j < r.scene.joint_count && count && near[0].verdict == NSVCD_FREE; j++) {
      const double step = 1e-3;
      double apart[2];
      if (r.joints[j].mimic) {
        CHECK(!(fabs(near[0].slope[j]) > 0));
        continue;
      }
      for (int n = 0; n < 2; n++) {
        double at[NSVCD_MAX_JOINTS];
        memcpy(at, q, sizeof at);
        at[j] += n ? step : -step;
        drive(&r, at);
        apart[n] = robot_apart(&r, &r.pairs[0], at, 4);
      }
      const double slope = (apart[1] - apart[0]) / (2 * step);
      compared += fabs(slope - near[0].slope[j]) < 0.02;
      found++;
    }
    nsvcd_nearest_free_options way;
    memset(&way, 0, sizeof way);
    way.farthest = 0.3;
    CHECK_EQ(nsvcd_nearest_free(r.checker, q, &way, out, &is_found), NSVCD_OK);
    double square = 0;
    for (size_t j = 0; j < r.scene.joint_count; j++) square += (out[j] - q[j]) * (out[j] - q[j]);
    if (is_found) CHECK(!(off_by(&r, out) > 0));
    if (is_found) CHECK_LE(sqrt(square), 0.3 + 1e-9);
    free(r.memory);
  }
  // where two points are as near, the slope jumps
  CHECK_GE(compared, 4 * found / 5);
  CHECK_GE(found, 50);
}

void test_mimics(void) {
  RUN(scenes_are_refused);
  RUN(broken_ones_are_refused);
  RUN(routes_of_a_gripper);
  RUN(ranges_of_mimics);
  RUN(ranges_of_mimics_see_the_nearest);
  RUN(what_slides_together_stays);
  RUN(reaches_of_mimics);
  RUN(slopes_and_ways_out);
}

CHECK_ALONE(test_mimics)
