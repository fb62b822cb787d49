// plan_scene.h - scenes to plan in: gantries and arms with bodies, in float and in double, a cost of
// collision by formula, and the planner's memory laid out. After the implementation.
#ifndef NSVCD_TESTS_PLAN_SCENE_H
#define NSVCD_TESTS_PLAN_SCENE_H

#include "../examples/scenery/oracle.h"
#include "query_scene.h"

#define PLAN_JOINTS 5
#define PLAN_BODIES 32
#define PLAN_VIA (NSVCD_MAX_VIA_POINTS + 2)

static void plan_random_numbers(shapes_rng *rng, size_t count, double reach, float *out) {
  for (size_t k = 0; k < count; k++) out[k] = (float)shapes_uniform(rng, -reach, reach);
}

typedef enum plan_kind { PLAN_XYZ, PLAN_ARMS } plan_kind;

// What place() can do wrong.
typedef enum plan_fault {
  PLAN_NO_FAULT,
  PLAN_NAN,
  PLAN_LONG_QUATERNION,
  PLAN_NAN_LATER
} plan_fault;

// PLAN_XYZ: body 0 moves by three joints. PLAN_ARMS: bodies 0 and 1 are two links, 2 another arm;
// five joints. The rest rests.
typedef struct plan_scene {
  nsvcd_plan_problem problem;
  nsvcd_plan_options options;
  plan_kind kind;
  plan_fault fault;
  float low[PLAN_JOINTS], high[PLAN_JOINTS], start[PLAN_JOINTS], goal[PLAN_JOINTS];
  const nsvcd_body *bodies[PLAN_BODIES];
  nsvcd_body_pair pairs[PLAN_BODIES * PLAN_BODIES];
  nsvcd_pose rest[PLAN_BODIES];
  double length;  // of the quaternions that place() gives; 0: 1
  int filling;    // what each byte of the workspace holds before
  size_t placed, attached;
  // What the progress callback saw.
  size_t again;          // refinements after the first of a seed
  size_t iterations[2];  // that MPPI and L-BFGS may have
  size_t reports, disorders, last_seed, last_iteration, out_of_place;
  int last_refining;
  float last_cost;
} plan_scene;

static void plan_turn(double x, double y, double z, double angle, double *q) {
  const double axis[3] = {x, y, z};
  oracle_axis_angle(axis, angle, q);
}

static void plan_at(const double *base, const double *q, double x, double y, double z,
                    oracle_pose *pose) {
  const oracle_pose frame = {{base[0], base[1], base[2]}, {q[0], q[1], q[2], q[3]}};
  const double v[3] = {x, y, z};
  oracle_transform(&frame, v, pose->position);
  memcpy(pose->rotation, q, 4 * sizeof *q);
}

static const double plan_base[3] = {0.55, 0, 0};  // of the second arm

static void plan_place_exactly(const plan_scene *s, const double *joints, oracle_pose *poses) {
  for (size_t b = 0; b < s->problem.body_count; b++) {
    for (int k = 0; k < 3; k++) poses[b].position[k] = (double)s->rest[b].position[k];
    for (int k = 0; k < 4; k++) poses[b].rotation[k] = (double)s->rest[b].rotation[k];
  }
  if (s->kind == PLAN_XYZ && s->problem.body_count) {
    for (int k = 0; k < 3; k++) poses[0].position[k] = joints[k];
    for (size_t b = 1; b <= s->attached; b++) {  // grasped: above the first
      for (int k = 0; k < 3; k++) poses[b].position[k] = joints[k] + (k == 2 ? 0.12 : 0);
    }
    return;
  }
  if (s->kind != PLAN_ARMS) return;
  const double origin[3] = {0, 0, 0};
  const double lifted[3] = {plan_base[0], plan_base[1], plan_base[2] + joints[4]};
  double first[4], by[4], second[4], other[4];
  oracle_pose elbow;
  plan_turn(0, 0, 1, joints[0], first);
  plan_turn(0, 1, 0, joints[1], by);
  oracle_quat_mul(first, by, second);
  plan_at(origin, first, 0.1, 0, 0, &poses[0]);
  plan_at(origin, first, 0.2, 0, 0, &elbow);
  plan_at(elbow.position, second, 0.1, 0, 0, &poses[1]);
  plan_turn(0, 0, 1, joints[2], by);
  plan_turn(1, 0, 0, joints[3], second);
  oracle_quat_mul(by, second, other);
  plan_at(lifted, other, -0.15, 0.03, 0, &poses[2]);
}

static void plan_place(void *user, const float *joints, nsvcd_pose *poses) {
  plan_scene *s = (plan_scene *)user;
  oracle_pose exact[PLAN_BODIES];
  double q[PLAN_JOINTS];
  for (size_t j = 0; j < s->problem.joints; j++) q[j] = (double)joints[j];
  plan_place_exactly(s, q, exact);
  for (size_t b = 0; b < s->problem.body_count; b++) {
    for (int k = 0; k < 3; k++) poses[b].position[k] = (float)exact[b].position[k];
    for (int k = 0; k < 4; k++)
      poses[b].rotation[k] = (float)(exact[b].rotation[k] * (s->length > 0 ? s->length : 1));
  }
  s->placed++;
  if (s->fault == PLAN_NAN || (s->fault == PLAN_NAN_LATER && s->placed > 50))
    poses[0].position[1] = NAN;
  if (s->fault == PLAN_LONG_QUATERNION) poses[0].rotation[3] = 1.1f;
}

static void plan_jacobian(void *user, const float *joints, float *jacobian) {
  const plan_scene *s = (const plan_scene *)user;
  const size_t f = s->problem.joints;
  memset(jacobian, 0, s->problem.body_count * 6 * f * sizeof *jacobian);
  if (s->kind == PLAN_XYZ) {
    for (size_t b = 0; b <= s->attached; b++) {
      for (size_t k = 0; k < 3; k++) jacobian[(6 * b + k) * f + k] = 1;
    }
    return;
  }
  oracle_pose poses[PLAN_BODIES];
  double q[PLAN_JOINTS];
  for (size_t j = 0; j < f; j++) q[j] = (double)joints[j];
  plan_place_exactly(s, q, poses);
  // Axes: joint, a point on it, its direction; and the body that it turns.
  const double c0 = cos(q[0]);
  const double s0 = sin(q[0]);
  const double c2 = cos(q[2]);
  const double s2 = sin(q[2]);
  const double axes[5][3] = {{0, 0, 1}, {0, 0, 1}, {-s0, c0, 0}, {0, 0, 1}, {c2, s2, 0}};
  const double points[5][3] = {{0, 0, 0},
                               {0, 0, 0},
                               {0.2 * c0, 0.2 * s0, 0},
                               {plan_base[0], plan_base[1], 0},
                               {plan_base[0], plan_base[1], q[4]}};
  const size_t body[5] = {0, 1, 1, 2, 2};
  const size_t joint[5] = {0, 0, 1, 2, 3};
  for (size_t n = 0; n < 5; n++) {
    double arm[3], moved[3];
    oracle_sub(poses[body[n]].position, points[n], arm);
    oracle_cross(axes[n], arm, moved);
    for (size_t k = 0; k < 3; k++) {
      jacobian[(6 * body[n] + k) * f + joint[n]] = (float)moved[k];
      jacobian[(6 * body[n] + 3 + k) * f + joint[n]] = (float)axes[n][k];
    }
  }
  jacobian[(6 * 2 + 2) * f + 4] = 1;
}

// A smooth cost of collision: a bump per pair and sample, of the distance of two points that are
// off the bodies' origins.
static void plan_bump_point(const oracle_pose *pose, size_t body, double *arm, double *point) {
  const double offset[3] = {0.05, 0.02 * (double)(body + 1), -0.04};
  double m[9];
  oracle_matrix(pose->rotation, m);
  oracle_rotate(m, offset, arm);
  for (int k = 0; k < 3; k++) point[k] = pose->position[k] + arm[k];
}

// of one sample
static double plan_bumps(const plan_scene *s, const oracle_pose *poses, double *gradient) {
  double sum = 0;
  for (size_t n = 0; n < s->problem.pair_count; n++) {
    const nsvcd_body_pair pair = s->problem.pairs[n];
    const size_t body[2] = {pair.a, pair.b};
    double arm[2][3], point[2][3], d[3];
    for (int side = 0; side < 2; side++)
      plan_bump_point(&poses[body[side]], body[side], arm[side], point[side]);
    oracle_sub(point[0], point[1], d);
    const double bump = exp(-oracle_dot(d, d) / 0.04);
    sum += bump;
    for (int side = 0; gradient && side < 2; side++) {
      double force[3], torque[3];
      for (int k = 0; k < 3; k++) force[k] = (side ? 1 : -1) * bump * 2 / 0.04 * d[k];
      oracle_cross(arm[side], force, torque);
      for (int k = 0; k < 3; k++) gradient[6 * body[side] + (size_t)k] += force[k];
      for (int k = 0; k < 3; k++) gradient[6 * body[side] + 3 + (size_t)k] += torque[k];
    }
  }
  return sum;
}

static oracle_pose plan_exact_pose(const nsvcd_pose *pose) {
  oracle_pose out;
  for (int k = 0; k < 3; k++) out.position[k] = (double)pose->position[k];
  for (int k = 0; k < 4; k++) out.rotation[k] = (double)pose->rotation[k];
  return out;
}

static float plan_bump_collision(void *user, const nsvcd_pose *poses, size_t samples, float limit,
                                 int *collides, float *gradient) {
  (void)limit;
  const plan_scene *s = (const plan_scene *)user;
  const size_t bodies = s->problem.body_count;
  double sum = 0;
  *collides = 0;
  for (size_t i = 0; i < samples; i++) {
    oracle_pose exact[PLAN_BODIES];
    double by_poses[6 * PLAN_BODIES] = {0};
    for (size_t b = 0; b < bodies; b++) exact[b] = plan_exact_pose(&poses[i * bodies + b]);
    const double bump = plan_bumps(s, exact, by_poses);
    for (size_t k = 0; gradient && k < 6 * bodies; k++)
      gradient[i * bodies * 6 + k] += (float)by_poses[k];
    *collides |= bump > 0.5;
    sum += bump;
  }
  return (float)sum;
}

static int plan_progress(void *user, const nsvcd_plan_progress *progress) {
  plan_scene *s = (plan_scene *)user;
  const size_t f = s->problem.joints;
  // in order: seeds, then stages, then iterations, each rising by one; the best never gets worse
  if (s->reports) {
    const int same_seed = progress->seed == s->last_seed;
    const int same_stage = progress->refining == s->last_refining;
    // Where a proof finds a hit, L-BFGS begins once more, with another margin.
    const int once_more = same_seed && same_stage && progress->refining && progress->iteration == 0;
    if (same_seed && same_stage && !once_more) {
      s->disorders += progress->iteration != s->last_iteration + 1 || progress->cost > s->last_cost;
    } else {
      s->disorders += progress->iteration != 0 ||
                      (same_seed ? !progress->refining : progress->seed != s->last_seed + 1);
      s->again += once_more;
    }
  } else {
    s->disorders += progress->iteration != 0 || progress->seed != 0;
  }
  s->disorders += progress->iteration >= progress->iterations;
  for (size_t j = 0; j < f; j++) {
    s->out_of_place += progress->control[j] != s->start[j];
    s->out_of_place += progress->control[(progress->via_points + 1) * f + j] != s->goal[j];
  }
  for (size_t k = 0; k < (progress->via_points + 2) * f; k++)
    s->out_of_place += !isfinite(progress->control[k]);
  s->iterations[progress->refining] = progress->iterations;
  s->last_seed = progress->seed;
  s->last_iteration = progress->iteration;
  s->last_refining = progress->refining;
  s->last_cost = progress->cost;
  s->reports++;
  return 0;
}

static void plan_begin(plan_scene *s, plan_kind kind, size_t bodies) {
  memset(s, 0, sizeof *s);
  s->kind = kind;
  for (size_t b = 0; b < PLAN_BODIES; b++) s->rest[b] = query_pose(0, 0, 0);
  for (size_t j = 0; j < PLAN_JOINTS; j++) {
    s->low[j] = -2;
    s->high[j] = 2;
  }
  s->problem.joints = kind == PLAN_XYZ ? 3 : 5;
  s->problem.low = s->low;
  s->problem.high = s->high;
  s->problem.start = s->start;
  s->problem.goal = s->goal;
  s->problem.bodies = s->bodies;
  s->problem.body_count = bodies;
  s->problem.pairs = s->pairs;
  s->problem.kinematics = plan_place;
  s->problem.progress = plan_progress;
  s->problem.user = s;
}

static void plan_pair(plan_scene *s, uint32_t a, uint32_t b) {
  const nsvcd_body_pair pair = {a, b};
  s->pairs[s->problem.pair_count++] = pair;
}

// Bodies that the tests share; they live until the process ends.
enum { PLAN_BALL, PLAN_BOX, PLAN_WALL, PLAN_LINK, PLAN_SHELL, PLAN_OFF_CENTRE, PLAN_SHAPES };

static shapes_mesh plan_shapes[PLAN_SHAPES];

static const nsvcd_body *plan_body(int shape) {
  static const nsvcd_body *bodies[PLAN_SHAPES];
  static query_memory memory[PLAN_SHAPES];
  if (bodies[shape]) return bodies[shape];
  shapes_mesh *mesh = &plan_shapes[shape];
  if (shape == PLAN_BALL) shapes_capsule(mesh, 0.05, 0, 16);
  if (shape == PLAN_BOX) shapes_box(mesh, 0.2, 0.16, 0.12, 4);
  if (shape == PLAN_WALL) shapes_box(mesh, 0.05, 0.4, 0.4, 6);
  if (shape == PLAN_LINK) shapes_box(mesh, 0.2, 0.06, 0.05, 4);
  if (shape == PLAN_SHELL) shapes_shell(mesh, 0.4, 0.4, 0.4, 0.03, 0, 16);
  if (shape == PLAN_OFF_CENTRE) {
    shapes_box(mesh, 0.2, 0.06, 0.05, 4);
    shapes_place(mesh, 0, NULL, 0.5, 0.1, 0);
  }
  nsvcd_mesh flat = mesh_of(mesh);
  bodies[shape] = query_encode(&flat, shape == PLAN_BALL ? 32 : 96, &memory[shape]);
  nsvcd_mesh_free(&flat, NULL);
  return bodies[shape];
}

// Two arms and a box within their reach: in one pair both bodies turn, in the other one does.
static void plan_arms_scene(plan_scene *s) {
  plan_begin(s, PLAN_ARMS, 4);
  for (int b = 0; b < 4; b++) s->bodies[b] = plan_body(b < 3 ? PLAN_LINK : PLAN_BOX);
  s->rest[3] = query_pose(0.3, 0.25, 0);
  plan_pair(s, 1, 2);
  plan_pair(s, 1, 3);
}

// A planner as nsvcd_plan sets it up, for the tests of its parts.
typedef struct plan_inside {
  nsvcd__planner planner;
  query_memory memory;
} plan_inside;

static int plan_open(plan_scene *s, plan_inside *in) {
  nsvcd__planner *p = &in->planner;
  const size_t size = nsvcd_plan_workspace_size(&s->problem, &s->options);
  CHECK(size > 0);
  in->memory = query_reserve(size);
  if (nsvcd__planner_settings(&s->problem, &s->options, p)) return 0;
  CHECK_EQ(nsvcd__planner_memory(p, (char *)in->memory.at), size);
  nsvcd__planner_begin(p);
  return 1;
}

static void plan_close(plan_inside *in) {
  query_release(&in->memory);
}

#endif
