// The sphere planner's collision cost (plan_spheres.h): do the spheres cover the bodies, is the
// cost what its formula says with the oracle's distances, is the gradient that of the cost.
#define _POSIX_C_SOURCE 200112L
#include "bench/plan_spheres.h"

#include "check.h"

void test_plan_spheres(void);

static task_scene plan_spheres_scene;
static plan_spheres plan_spheres_tested;

static void plan_spheres_pose_at(const nsvcd_pose *from, oracle_pose *to) {
  for (int k = 0; k < 3; k++) to->position[k] = (double)from->position[k];
  for (int k = 0; k < 4; k++) to->rotation[k] = (double)from->rotation[k];
}
// The distance of a point from a mesh by all of its triangles, and its sign by the winding number.
static double plan_spheres_truth(const task_body *body, const oracle_pose *pose,
                                 const double *world) {
  double m[9];
  double d[3];
  double x[3];
  double least = HUGE_VAL;
  oracle_matrix(pose->rotation, m);
  oracle_sub(world, pose->position, d);
  oracle_rotate_back(m, d, x);
  oracle_triangle point;
  memset(&point, 0, sizeof point);
  for (size_t t = 0; t < body->mesh.triangle_count; t++) {
    // Ericson 2005: the nearest point of a triangle, by the regions of its corners and edges.
    double p[3][3], ab[3], ac[3], ap[3], bp[3], cp[3], at[3], away[3];
    for (int c = 0; c < 3; c++)
      for (int k = 0; k < 3; k++)
        p[c][k] =
            (double)
                body->mesh.positions[3 * (size_t)body->mesh.indices[3 * t + (size_t)c] + (size_t)k];
    oracle_sub(p[1], p[0], ab);
    oracle_sub(p[2], p[0], ac);
    oracle_sub(x, p[0], ap);
    oracle_sub(x, p[1], bp);
    oracle_sub(x, p[2], cp);
    double d1 = oracle_dot(ab, ap);
    double d2 = oracle_dot(ac, ap);
    double d3 = oracle_dot(ab, bp);
    double d4 = oracle_dot(ac, bp);
    double d5 = oracle_dot(ab, cp);
    double d6 = oracle_dot(ac, cp);
    double va = d3 * d6 - d5 * d4;
    double vb = d5 * d2 - d1 * d6;
    double vc = d1 * d4 - d3 * d2;
    double v;
    double w;
    if (d1 <= 0 && d2 <= 0) {
      v = 0;
      w = 0;
    } else if (d3 >= 0 && d4 <= d3) {
      v = 1;
      w = 0;
    } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
      v = d1 / (d1 - d3);
      w = 0;
    } else if (d6 >= 0 && d5 <= d6) {
      v = 0;
      w = 1;
    } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
      v = 0;
      w = d2 / (d2 - d6);
    } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
      w = (d4 - d3) / (d4 - d3 + d5 - d6);
      v = 1 - w;
    } else {
      v = vb / (va + vb + vc);
      w = vc / (va + vb + vc);
    }
    for (int k = 0; k < 3; k++) at[k] = p[0][k] + v * ab[k] + w * ac[k];
    oracle_sub(x, at, away);
    least = fmin(least, oracle_length(away));
  }
  return fabs(oracle_winding(&body->exact, x)) > 0.5 ? -least : least;
}
// The cost by the formula; what an error of `slack` in each distance can change in it; the least
// distance.
static double plan_spheres_formula(const plan_spheres *s, const task_scene *scene,
                                   const nsvcd_pose *poses, double slack, double *change,
                                   double *least) {
  double sum = 0;
  double e = (double)s->activation;
  *change = 0, *least = HUGE_VAL;
  for (int k = 0; k < s->pair_count; k++) {
    const plan_spheres_body *a = &s->bodies[s->pairs[k][0]];
    const task_body *b = &scene->bodies[s->pairs[k][1]];
    oracle_pose at, of;
    plan_spheres_pose_at(&poses[s->pairs[k][0]], &at);
    plan_spheres_pose_at(&poses[s->pairs[k][1]], &of);
    for (size_t i = 0; i < a->fit->ball_count; i++) {
      const spheres_ball *ball = &a->fit->balls[i];
      double c[3] = {(double)ball->centre[0], (double)ball->centre[1], (double)ball->centre[2]};
      double world[3];
      double to[3];
      oracle_transform(&at, c, world);
      oracle_transform(&of, b->exact.center, to);
      oracle_sub(world, to, to);
      if (oracle_length(to) > b->exact.radius + e + (double)ball->radius) continue;
      double d = plan_spheres_truth(b, &of, world) - (double)ball->radius;
      *least = fmin(*least, d);
      sum += d >= e ? 0 : d >= 0 ? (e - d) * (e - d) / 2 / e : e / 2 - d;
      *change += d >= e + slack ? 0 : slack;
    }
  }
  return sum;
}
static void plan_spheres_random(task_scene *scene, double spread, float *joints) {
  const task_problem *p = &scene->problems[scene->selected];
  // the peg is near late
  double f = shapes_uniform(&scene->rng, scene->problem_count > 1 ? 0 : 0.9, 1);
  for (int j = 0; j < scene->joint_count; j++)
    joints[j] = (float)((double)p->start[j] + f * (double)(p->goal[j] - p->start[j]) +
                        shapes_uniform(&scene->rng, -spread, spread));
}
// the task that scene and spheres are of: making them takes most of the time
static int plan_spheres_made = -1;
static void plan_spheres_unmake(void) {
  if (plan_spheres_made >= 0) {
    plan_spheres_free(&plan_spheres_tested);
    task_free(&plan_spheres_scene);
  }
  plan_spheres_made = -1;
}
static int plan_spheres_make(int task, float activation, int exact) {
  task_scene *scene = &plan_spheres_scene;
  plan_spheres *s = &plan_spheres_tested;
  if (plan_spheres_made != task) {
    plan_spheres_unmake();
    if (!(task == 0 ? task_dish_episode(scene, 1) : task_bimanual_episode(scene, 1))) return 0;
    if (!plan_spheres_init(s, scene, 397, 200, 0.04f, 2, exact)) return 0;
    plan_spheres_made = task;
  }
  s->activation = activation;
  s->exact = exact;  // no more than what the grids were made for
  if (task == 0) task_select(scene, 1);
  return plan_spheres_select(s, scene);
}

static void plan_spheres_cover_bodies(void) {
  CHECK(plan_spheres_make(0, 0.04f, 0));
  size_t robot = 0;
  size_t inside = 0;
  size_t all = 0;
  for (int i = 0; i < plan_spheres_scene.body_count; i++) {
    const plan_spheres_body *b = &plan_spheres_tested.bodies[i];
    const task_body *body = &plan_spheres_scene.bodies[i];
    const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
    spheres_body points;
    size_t covered = 0;
    if (!b->eight_count) continue;
    if (body->kind == TASK_ROBOT) robot += b->fit->ball_count;
    if (body->kind != TASK_ROBOT) CHECK_EQ(b->fit->ball_count, 200);
    // none stands out by more than a surface point's 2 mm
    for (size_t k = 0; k < b->fit->ball_count; k++) {
      const float *c = b->fit->balls[k].centre;
      const float r = b->fit->balls[k].radius;
      const double x[3] = {(double)c[0], (double)c[1], (double)c[2]};
      inside +=
          plan_spheres_truth(body, &origin, x) <= (r > 0.002f ? -(double)r : (double)r) + 1e-5;
      all++;
    }
    memset(&points, 0, sizeof points);
    CHECK(spheres_sample(&points, &body->mesh, 2000));
    for (size_t k = 0; k < points.ball_count; k++) {
      float gap = 1;
      for (size_t n = 0; n < b->fit->ball_count; n++) {
        float d[3];
        for (int j = 0; j < 3; j++) d[j] = points.balls[k].centre[j] - b->fit->balls[n].centre[j];
        gap = fminf(gap, sqrtf(plan_spheres_dot(d, d)) - b->fit->balls[n].radius);
      }
      covered += gap < 0.02f;
    }
    CHECK_GE(covered, 0.97 * (double)points.ball_count);
    free(points.balls);
  }
  CHECK_EQ(robot, 397);
  CHECK_EQ(inside, all);
}
static void plan_spheres_cost_is_the_formulas(void) {
  static nsvcd_pose poses[TASK_MAX_BODIES];
  for (int n = 0; n < 4; n++) {
    int exact = n % 2;
    int near = 0;
    CHECK(plan_spheres_make(n / 2, n / 2 ? 0.01f : 0.04f, exact));
    for (int k = 0; k < 5; k++) {
      float joints[TASK_MAX_JOINTS];
      double change;
      double least;
      double slack = exact ? 1e-6 : 4 * (double)PLAN_SPHERES_ERROR;
      int collides = 0;
      plan_spheres_random(&plan_spheres_scene, n / 2 ? 0.02 : 0.3, joints);
      task_place(&plan_spheres_scene, joints, poses);
      double cost =
          (double)plan_spheres_cost(&plan_spheres_tested, poses, 1, HUGE_VALF, &collides, NULL) / 2;
      double expected = plan_spheres_formula(&plan_spheres_tested, &plan_spheres_scene, poses,
                                             slack, &change, &least);
      CHECK_NEAR(cost, expected, change + 1e-5 * expected + 1e-6);
      CHECK(collides ? least < slack : least > -slack);
      near += cost > 0;
    }
    CHECK_GE(near, 2);
  }
}
// By a displacement along axis k < 3, or a turn about it, of one body.
static float plan_spheres_shifted(const nsvcd_pose *poses, int body, int k, double step,
                                  int count) {
  static nsvcd_pose moved[TASK_MAX_BODIES];
  int collides = 0;
  memcpy(moved, poses, (size_t)count * sizeof *moved);
  if (k < 3) {
    moved[body].position[k] += (float)step;
  } else {
    double axis[3] = {k == 3, k == 4, k == 5};
    double turn[4];
    double old[4];
    double out[4];
    oracle_axis_angle(axis, step, turn);
    for (int j = 0; j < 4; j++) old[j] = (double)poses[body].rotation[j];
    oracle_quat_mul(turn, old, out);
    for (int j = 0; j < 4; j++) moved[body].rotation[j] = (float)out[j];
  }
  return plan_spheres_cost(&plan_spheres_tested, moved, 1, HUGE_VALF, &collides, NULL);
}
static void plan_spheres_gradient_is_the_costs(void) {
  static nsvcd_pose poses[TASK_MAX_BODIES];
  static float gradient[6 * TASK_MAX_BODIES];
  for (int n = 0; n < 4; n++) {
    CHECK(plan_spheres_make(n / 2, 0.04f, n % 2));
    double wrong = 0;
    double norm = 0;
    int count = plan_spheres_scene.body_count;
    for (int k = 0; k < 5; k++) {
      float joints[TASK_MAX_JOINTS];
      int collides = 0;
      plan_spheres_random(&plan_spheres_scene, n / 2 ? 0.02 : 0.2, joints);
      task_place(&plan_spheres_scene, joints, poses);
      memset(gradient, 0, sizeof gradient);
      plan_spheres_cost(&plan_spheres_tested, poses, 1, HUGE_VALF, &collides, gradient);
      for (int i = 0; i < count; i++)
        for (int j = 0; j < 6; j++) {
          double step = n % 2 ? 2e-4 : 1e-3;
          double by_steps = (double)(plan_spheres_shifted(poses, i, j, step, count) -
                                     plan_spheres_shifted(poses, i, j, -step, count)) /
                            (2 * step);
          wrong +=
              (by_steps - (double)gradient[6 * i + j]) * (by_steps - (double)gradient[6 * i + j]);
          norm += by_steps * by_steps;
        }
    }
    // Kinks where the nearest part changes, and, with the grid, steps from cell to cell, are not in
    // a derivative.
    CHECK_GE(norm, 1);
    CHECK_LE(sqrt(wrong), (n % 2 ? 0.02 : 0.1) * sqrt(norm));
  }
}
static void plan_spheres_far_is_free(void) {
  static nsvcd_pose poses[3 * TASK_MAX_BODIES];
  static float gradient[18 * TASK_MAX_BODIES];
  CHECK(plan_spheres_make(0, 0.04f, 0));
  int collides = 0;
  int count = plan_spheres_scene.body_count;
  for (int i = 0; i < 3 * count; i++) {  // 3 m from each other
    poses[i].position[0] = 3 * (float)(i % count);
    poses[i].rotation[3] = 1;
  }
  CHECK_EQ(plan_spheres_cost(&plan_spheres_tested, poses, 3, HUGE_VALF, &collides, gradient), 0);
  CHECK_EQ(collides, 0);
  for (int i = 0; i < 18 * count; i++) CHECK_EQ(gradient[i], 0);
  // Starts and goals keep 3 mm from everything: no sphere stands out by more than 2.
  for (int k = 0; k < 3; k++) {
    task_select(&plan_spheres_scene, k);
    CHECK(plan_spheres_select(&plan_spheres_tested, &plan_spheres_scene));
    task_place(&plan_spheres_scene, plan_spheres_scene.problems[k].start, poses);
    task_place(&plan_spheres_scene, plan_spheres_scene.problems[k].goal, poses + count);
    CHECK_GE(plan_spheres_cost(&plan_spheres_tested, poses, 2, HUGE_VALF, &collides, NULL), 1e-6);
    CHECK_EQ(collides, 0);
  }
}

void test_plan_spheres(void) {
  RUN(plan_spheres_cover_bodies);
  RUN(plan_spheres_far_is_free);
  RUN(plan_spheres_cost_is_the_formulas);
  RUN(plan_spheres_gradient_is_the_costs);
  plan_spheres_unmake();
}

CHECK_ALONE(test_plan_spheres)
