// The trajectory optimizer: cost and its gradient against references in double, culling against
// queries, then nsvcd_plan through the public API: what it finds, what it refuses, and a thousand
// scenes in which nothing can be done.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"
#include "../src/body/scale.h"
#include "../src/body/encode.h"
#include "../src/plan/plan.h"

#include "plan_scene.h"

void test_optimizer(void);

// ------------------------------------------------------------------------------- cost and gradient

// The whole cost in double, written from the header's comments: weighted means of squares per
// second, joints beyond their limits, bumps. control: (via + 2, F).
static double plan_exact_cost(const plan_scene *s, const nsvcd_plan_options *o, size_t via,
                              size_t segments, const double *control) {
  const size_t f = s->problem.joints;
  const double weights[3] = {(double)o->velocity, (double)o->acceleration, (double)o->jerk};
  double w[PLAN_VIA];
  double cost = 0;
  for (size_t derivative = 1; derivative <= 3; derivative++) {
    const size_t steps = 100 * (via + 1);
    for (size_t n = 0; n < steps; n++) {
      nsvcd__spline_weights(via, ((double)n + 0.5) / (double)steps, derivative, w);
      for (size_t j = 0; j < f; j++) {
        double x = 0;
        for (size_t k = 0; k < via + 2; k++) x += w[k] * control[k * f + j];
        x /= pow((double)o->duration, (double)derivative);
        cost += weights[derivative - 1] * x * x / (double)steps;
      }
    }
  }
  for (size_t n = 0; n <= segments; n++) {
    double joints[PLAN_JOINTS];
    oracle_pose poses[PLAN_BODIES];
    nsvcd__spline_weights(via, (double)n / (double)segments, 0, w);
    for (size_t j = 0; j < f; j++) {
      joints[j] = 0;
      for (size_t k = 0; k < via + 2; k++) joints[j] += w[k] * control[k * f + j];
      const double inner = 0.005 * (double)(s->high[j] - s->low[j]);
      const double out = fmax(
          0, fmax((double)s->low[j] + inner - joints[j], joints[j] - (double)s->high[j] + inner));
      cost += 1e5 * out * out / (double)(segments + 1);
    }
    plan_place_exactly(s, joints, poses);
    cost += (double)o->collision * plan_bumps(s, poses, NULL);
  }
  return cost;
}

// kind of place(); with the jacobian or by differences; with the limits in the way or not.
static void plan_gradient_case(plan_kind kind, int jacobian, int limits, double *worst) {
  static plan_scene s;
  shapes_rng rng = {(uint64_t)(10 + kind * 4 + jacobian * 2 + limits)};
  plan_begin(&s, kind, kind == PLAN_XYZ ? 3 : 4);
  s.problem.collision = plan_bump_collision;
  if (jacobian) s.problem.jacobian = plan_jacobian;
  s.rest[s.problem.body_count - 1] = query_pose(0.2, 0.1, 0.05);
  if (kind == PLAN_XYZ) {
    s.attached = 1;
    plan_pair(&s, 0, 2);
    plan_pair(&s, 2, 1);
  } else {
    plan_pair(&s, 0, 2);
    plan_pair(&s, 2, 1);
    plan_pair(&s, 1, 3);  // both move, both move, one does
  }
  for (size_t j = 0; j < PLAN_JOINTS; j++) {
    s.low[j] = limits ? -0.2f : -3;
    s.high[j] = limits ? 0.25f : 3;
  }
  for (int n = 0; n < 8; n++) {
    const size_t via = 1 + (size_t)shapes_pick(&rng, 12);
    const size_t f = s.problem.joints;
    const size_t numbers = (via + 2) * f;
    float control[PLAN_VIA * PLAN_JOINTS], gradient[PLAN_VIA * PLAN_JOINTS];
    double exact[PLAN_VIA * PLAN_JOINTS];
    double norm = 0;
    double difference = 0;
    plan_inside in;
    s.options.refine.via_points = via;
    s.options.refine.segments = 5 + (size_t)shapes_pick(&rng, 20);
    s.options.collision = (float)shapes_uniform(&rng, 0.5, 20);
    s.options.velocity = (float)shapes_uniform(&rng, 1, 20);
    s.options.duration = n % 2 ? 2.0f : 40.0f;  // smoothness outweighs the bumps, or they it
    plan_random_numbers(&rng, numbers, 0.3, control);
    for (size_t k = 0; k < numbers; k++) exact[k] = (double)control[k];
    if (!plan_open(&s, &in)) continue;
    nsvcd__planner *p = &in.planner;
    const size_t segments = p->refine.moments - 1;
    const nsvcd__cost cost = nsvcd__cost_of(p, &p->refine, control, INFINITY, gradient);
    const nsvcd__cost again = nsvcd__cost_of(p, &p->refine, control, INFINITY, NULL);
    const double whole = plan_exact_cost(&s, &p->options, via, segments, exact);
    CHECK_EQ(p->error, NSVCD_OK);
    CHECK_EQ(cost.total, again.total);  // the gradient does not change it
    CHECK_NEAR(cost.total, whole, 2e-3 * whole);
    for (size_t k = 0; k < numbers; k++) {
      const double h = 1e-6;
      const double here = exact[k];
      exact[k] = here + h;
      const double above = plan_exact_cost(&s, &p->options, via, segments, exact);
      exact[k] = here - h;
      const double below = plan_exact_cost(&s, &p->options, via, segments, exact);
      exact[k] = here;
      const double slope = (above - below) / (2 * h);
      norm += slope * slope;
      difference += pow(slope - (double)gradient[k], 2);
    }
    CHECK_LE(sqrt(difference), 0.003 * sqrt(norm));
    *worst = fmax(*worst, sqrt(difference / norm));
    plan_close(&in);
  }
}

// Who decides the network's cost: the pairs of patches of every segment that costs, and of every
// run looked at.
static uint64_t plan_decisive(nsvcd__planner *p, const nsvcd__stage *stage, const float *control) {
  uint64_t hash = 1469598103934665603u;
  nsvcd__cost_of(p, stage, control, INFINITY, NULL);  // p->poses
  for (uint32_t k = 0; k < p->in->pair_count; k++) {
    for (size_t s = 0; s + 1 < stage->moments; s++) {
      const nsvcd_answer answer = nsvcd__ask_segments(p, k, s, 1, 0, NULL);
      if (logit_of(&answer) <= -p->options.margin) continue;
      hash = (hash ^ (k * 4096 + s)) * 1099511628211u;
      hash = (hash ^ (answer.opinion.patch_a * 512 + answer.opinion.patch_b)) * 1099511628211u;
    }
  }
  return hash;
}

// Along random directions in which the same pairs decide, and the slopes over one and over two
// steps agree: there are kinks (ReLU, which segment of a pair's contact).
static void plan_network_gradient_case(plan_kind kind, int *tried, int *smooth, int *right,
                                       double *worst) {
  static plan_scene s;
  shapes_rng rng = {(uint64_t)(20 + kind)};
  plan_inside in;
  if (kind == PLAN_XYZ) {
    plan_begin(&s, kind, 2);
    s.bodies[0] = plan_body(PLAN_BALL);
    s.bodies[1] = plan_body(PLAN_BOX);
    plan_pair(&s, 0, 1);
  } else {
    plan_arms_scene(&s);
  }
  s.options.refine.via_points = 4;
  s.options.refine.segments = 10;
  s.options.velocity = s.options.jerk = 0.1f;
  s.options.acceleration = -1;
  s.options.collision = 1;
  s.options.sweep.network.precision = NSVCD_PRECISION_FLOAT;
  if (!plan_open(&s, &in)) return;
  nsvcd__planner *p = &in.planner;
  const size_t f = s.problem.joints;
  const size_t numbers = 6 * f;
  for (int n = 0; n < (kind == PLAN_XYZ ? 400 : 500); n++) {
    float control[6 * PLAN_JOINTS], moved[6 * PLAN_JOINTS], gradient[6 * PLAN_JOINTS],
        direction[6 * PLAN_JOINTS];
    float at[5];
    double slope = 0;
    if (kind == PLAN_XYZ) {
      plan_random_numbers(&rng, numbers, 0.16, control);
      for (size_t k = 0; k < 6; k++) control[k * f] = -0.25f + 0.1f * (float)k;
    } else {
      for (size_t k = 0; k < numbers; k++) control[k] = (float)shapes_uniform(&rng, -0.5, 0.5);
    }
    plan_random_numbers(&rng, numbers, 1, direction);
    const nsvcd__cost cost = nsvcd__cost_of(p, &p->refine, control, INFINITY, gradient);
    if (cost.collision <= 0) continue;
    for (size_t k = 0; k < numbers; k++) slope += (double)gradient[k] * (double)direction[k];
    (*tried)++;
    const uint64_t who = plan_decisive(p, &p->refine, control);
    int same = 1;
    for (int i = -2; i <= 2; i++) {
      for (size_t k = 0; k < numbers; k++) moved[k] = control[k] + 1e-4f * (float)i * direction[k];
      same = same && plan_decisive(p, &p->refine, moved) == who;
      at[i + 2] = nsvcd__cost_of(p, &p->refine, moved, INFINITY, NULL).total;
    }
    const double near = ((double)at[3] - (double)at[1]) / 2e-4;
    const double far = ((double)at[4] - (double)at[0]) / 4e-4;
    const double left = ((double)at[2] - (double)at[1]) / 1e-4;
    const double right_side = ((double)at[3] - (double)at[2]) / 1e-4;
    if (!same || fabs(near - far) > 0.01 * fabs(near) || fabs(left - right_side) > 0.1 * fabs(near))
      continue;
    (*smooth)++;
    const double error = fabs(slope - near) / fabs(near);
    *right += error < 0.03;
    *worst = fmax(*worst, error);
  }
  CHECK_EQ(p->error, NSVCD_OK);
  plan_close(&in);
}

// ----------------------------------------------------------------------------------------- culling

// Random scenes: everything moves and turns at random, by up to two radians from one sample to the
// next; one in two bodies lies off its origin.
static void plan_random_poses(shapes_rng *rng, nsvcd__planner *p, size_t samples, double reach,
                              double turn) {
  const size_t bodies = p->in->body_count;
  const int fast = shapes_pick(rng, 2);
  for (size_t b = 0; b < bodies; b++) {
    nsvcd_pose at;
    double axis[3];
    double way[3];
    double angle = shapes_uniform(rng, -turn, turn);
    double q[4];
    const double speed = (!fast ? 0.3 : b ? 0.3 + 1.5 * shapes_pick(rng, 4) : 0.1) * reach;
    query_random_pose(rng, reach, &at);
    shapes_direction(rng, axis);
    shapes_direction(rng, way);
    // its origin comes close to the first body's
    if (b > 0 && shapes_pick(rng, 3) < (fast ? 2 : 1)) {
      for (int k = 0; k < 3; k++)
        at.position[k] = p->poses[0].position[k] + (float)shapes_uniform(rng, -0.2, 0.2);
    }
    for (size_t s = 0; s < samples; s++) {
      nsvcd_pose *pose = &p->poses[s * bodies + b];
      float by[4];
      plan_turn(axis[0], axis[1], axis[2], angle * (double)s, q);
      for (int k = 0; k < 4; k++) by[k] = (float)q[k];
      query_multiply(by, at.rotation, pose->rotation);
      for (int k = 0; k < 3; k++)
        pose->position[k] =
            at.position[k] + (float)(speed * way[k] * ((double)s - (fast ? 3.5 : 4)));
    }
  }
}

// --------------------------------------------------------------------------------------- behaviour

#define PLAN_GUARD 64

typedef struct plan_outcome {
  nsvcd_result result;
  nsvcd_plan_answer answer;
  float control[PLAN_VIA * PLAN_JOINTS];
  size_t via;
} plan_outcome;

// nsvcd_plan with a workspace of just the size asked for and guards behind it and behind control;
// and what holds of every answer: bounds, counts, finite numbers, start and goal in place; and of
// every error: nothing written.
static plan_outcome plan_run(plan_scene *s) {
  static const unsigned char untouched = 0x5a;
  plan_outcome out;
  const nsvcd_plan_options *o = &s->options;
  const size_t size = nsvcd_plan_workspace_size(&s->problem, o);
  const size_t f = s->problem.joints;
  const size_t refine = o->refine.iterations == NSVCD_NONE ? 0
                        : o->refine.iterations             ? o->refine.iterations
                                                           : 10;
  const size_t explore = o->explore.iterations == NSVCD_NONE ? 0
                         : o->explore.iterations             ? o->explore.iterations
                                                             : 40;
  const size_t tries = o->explore.draws ? o->explore.draws : 100;
  const size_t bundle = o->refine.draws ? o->refine.draws : 10;
  query_memory memory = query_reserve(size + PLAN_GUARD);
  size_t written = 0;
  memset(memory.at, s->filling, size);
  s->reports = s->disorders = s->out_of_place = s->placed = s->again = 0;
  memset(&out, untouched, sizeof out);
  out.via = o->refine.iterations == NSVCD_NONE ? (o->explore.via_points ? o->explore.via_points : 5)
                                               : (o->refine.via_points ? o->refine.via_points : 10);
  out.result = nsvcd_plan(&s->problem, o, memory.at, size, out.control, &out.answer);
  for (size_t k = size; k < size + PLAN_GUARD; k++)
    CHECK_EQ(((unsigned char *)memory.at)[k], untouched);
  query_release(&memory);
  const size_t numbers = out.result || out.via > NSVCD_MAX_VIA_POINTS ? 0 : (out.via + 2) * f;
  for (size_t k = numbers * sizeof(float); k < sizeof out.control; k++)
    written += ((unsigned char *)out.control)[k] != untouched;
  if (out.result) {
    for (size_t k = 0; k < sizeof out.answer; k++)
      written += ((unsigned char *)&out.answer)[k] != untouched;
  }
  CHECK_EQ(written, 0);
  if (out.result) return out;
  const nsvcd_plan_answer *a = &out.answer;
  const size_t seeds = o->seeds ? o->seeds : 6;
  for (size_t k = 0; k < numbers; k++) CHECK(isfinite(out.control[k]));
  for (size_t j = 0; j < f; j++) {
    CHECK_EQ(out.control[j], s->start[j]);
    CHECK_EQ(out.control[(out.via + 1) * f + j], s->goal[j]);
  }
  CHECK_EQ(a->via_points, out.via);
  // What a proof finds to be a hit is refined three times more.
  const size_t rounds = 4;
  CHECK(a->seeds <= seeds && a->iterations <= a->seeds * (explore + rounds * refine));
  CHECK_LE(a->trajectories,
           a->seeds * (explore * tries + rounds * (refine * (bundle + 5) + 2) + 1));
  CHECK(isfinite(a->cost) && isfinite(a->smoothness) && isfinite(a->logit) && a->time >= 0 &&
        a->time <= 1);
  CHECK(isfinite(a->deviation) && a->deviation >= 0);
  CHECK(a->pair == NSVCD_NONE || a->pair < s->problem.pair_count);
  CHECK(a->joint == NSVCD_NONE || a->joint < f);
  if (a->status == NSVCD_PLAN_CONVERGED) CHECK(!a->collides && a->joint == NSVCD_NONE);
  for (size_t k = 0; k < numbers && a->status == NSVCD_PLAN_CONVERGED; k++) {
    CHECK_GE(out.control[k], s->low[k % f] - 2e-5f);
    CHECK_LE(out.control[k], s->high[k % f] + 2e-5f);
  }
  // there is a reason, and only one
  if (a->status == NSVCD_PLAN_START || a->status == NSVCD_PLAN_GOAL) {
    CHECK((a->joint != NSVCD_NONE) !=
          (a->collides && (a->pair != NSVCD_NONE || s->problem.collision)));
  }
  if (s->problem.progress) {
    CHECK_EQ(s->reports, a->iterations);
    CHECK_EQ(s->disorders, 0);
    CHECK_EQ(s->out_of_place, 0);
  }
  return out;
}

// A ball that must go round a wall.
static void plan_wall_scene(plan_scene *s) {
  plan_begin(s, PLAN_XYZ, 2);
  s->bodies[0] = plan_body(PLAN_BALL);
  s->bodies[1] = plan_body(PLAN_WALL);
  plan_pair(s, 0, 1);
  for (size_t j = 0; j < 3; j++) {
    s->low[j] = -0.5f;
    s->high[j] = 0.5f;
  }
  s->start[0] = -0.3f;
  s->goal[0] = 0.3f;
  s->start[1] = 0.02f;
  s->start[2] = -0.03f;
}

// The least distance of the two surfaces along the trajectory, exactly, on fine samples.
static double plan_exact_distance(const plan_scene *s, const plan_outcome *out, int shape_a,
                                  int shape_b) {
  enum { COUNT = 401 };
  static oracle_pose poses[COUNT];
  oracle_mesh a, b;
  const oracle_pose wall = plan_exact_pose(&s->rest[1]);
  const shapes_mesh *x = &plan_shapes[shape_a];
  const shapes_mesh *y = &plan_shapes[shape_b];
  CHECK(oracle_mesh_init(&a, x->positions, x->vertices, x->indices, x->triangles, 1));
  CHECK(oracle_mesh_init(&b, y->positions, y->vertices, y->indices, y->triangles, 1));
  for (int n = 0; n < COUNT; n++) {
    float joints[PLAN_JOINTS];
    nsvcd_pose placed[PLAN_BODIES];
    nsvcd_spline(out->control, out->via, s->problem.joints, (float)n / (COUNT - 1), 0, joints);
    plan_place((void *)(uintptr_t)s, joints, placed);
    poses[n] = plan_exact_pose(&placed[0]);
  }
  const oracle_result found = oracle_sweep(&a, poses, COUNT, &b, &wall, NULL);
  oracle_mesh_free(&a);
  oracle_mesh_free(&b);
  return found.status == ORACLE_FREE ? found.distance : 0;
}

static void plan_goes_round_a_wall(void) {
  static plan_scene s;
  double least = 1;
  plan_wall_scene(&s);
  nsvcd_plan_answer unused;
  memset(&unused, 0, sizeof unused);
  for (uint64_t seed = 1; seed <= 8; seed++) {
    s.options.seed = seed;
    plan_outcome out = plan_run(&s);
    CHECK_EQ(out.result, NSVCD_OK);
    CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
    CHECK_GE(s.reports, 3);
    const double distance = plan_exact_distance(&s, &out, PLAN_BALL, PLAN_WALL);
    CHECK_GE(distance, 1e-3);
    least = fmin(least, distance);
    for (int n = 0; n <= 400; n++) {
      float x[3];
      nsvcd_spline(out.control, out.via, 3, (float)n / 400, 0, x);
      for (size_t j = 0; j < 3; j++) CHECK(x[j] >= s.low[j] - 1e-4f && x[j] <= s.high[j] + 1e-4f);
    }
  }
  printf("  of 8 seeds the least exact distance is %.1f mm\n", 1000 * least);
}

static int plan_same(const plan_outcome *a, const plan_outcome *b, size_t joints) {  // to the bit
  return a->result == b->result && a->answer.status == b->answer.status &&
         a->answer.cost == b->answer.cost && a->answer.deviation == b->answer.deviation &&
         a->answer.logit == b->answer.logit && a->answer.sweeps == b->answer.sweeps &&
         a->answer.iterations == b->answer.iterations &&
         a->answer.trajectories == b->answer.trajectories &&
         memcmp(a->control, b->control, (a->via + 2) * joints * sizeof(float)) == 0;
}

// Options that are zero are those that the header writes beside them. The goal is in a shell: all
// seeds are used; limits are so wide that they do not narrow the noise.
static void plan_defaults_are_what_is_written(void) {
  static const nsvcd_plan_options written = {.seeds = 6,
                                             .explore = {5, 24, 40, 100, 0.3f},
                                             .refine = {10, 22, 10, 10, 0.01f},
                                             .velocity = 10,
                                             .acceleration = 2,
                                             .jerk = 10,
                                             .collision = 20,
                                             .duration = 20,
                                             .margin = 2,
                                             .check = 384};
  static plan_scene s;
  plan_wall_scene(&s);
  s.bodies[1] = plan_body(PLAN_SHELL);
  s.rest[1] = query_pose((double)s.goal[0] + 0.1, 0, 0);
  for (size_t j = 0; j < 3; j++) s.low[j] = -(s.high[j] = 2);
  memset(&s.options, 0, sizeof s.options);
  const plan_outcome defaults = plan_run(&s);
  CHECK_EQ(s.iterations[0], written.explore.iterations);
  CHECK_EQ(s.iterations[1], written.refine.iterations);
  s.options = written;
  const plan_outcome same = plan_run(&s);
  CHECK_EQ(defaults.result, NSVCD_OK);
  CHECK_EQ(defaults.answer.seeds, 6);
  CHECK(plan_same(&defaults, &same, 3));
}

// Of several starts, none of which ends free, the best is kept: with one more the answer costs no
// more, and is the same where it costs as much.
static void plan_keeps_the_best_of_its_seeds(void) {
  static plan_scene s;
  static plan_outcome best;
  int better = 0;
  best.answer.cost = INFINITY;
  plan_wall_scene(&s);
  s.bodies[1] = plan_body(PLAN_SHELL);  // around the goal
  s.rest[1] = query_pose((double)s.goal[0] + 0.1, 0, 0);
  s.start[0] = -0.45f;
  s.options.explore.iterations = s.options.refine.iterations = NSVCD_NONE;
  for (size_t seeds = 1; seeds <= 12; seeds++) {
    s.options.seeds = seeds;
    const plan_outcome out = plan_run(&s);
    CHECK_EQ(out.answer.status, NSVCD_PLAN_LIMIT);
    CHECK_EQ(out.answer.seeds, seeds);
    CHECK_LE(out.answer.cost, best.answer.cost);
    const int is_better = out.answer.cost < best.answer.cost;
    const size_t bytes = (out.via + 2) * s.problem.joints * sizeof(float);
    if (!is_better) CHECK(memcmp(out.control, best.control, bytes) == 0);
    better += seeds > 1 && is_better;
    best = out;
  }
  CHECK(better >= 1 && better < 11);
}

static void plan_grasped_bodies_move_along(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  s.bodies[2] = s.bodies[0];
  s.problem.body_count = 3;  // between: the wall. The second ball is body 1 now
  s.bodies[1] = s.bodies[0];
  s.bodies[2] = plan_body(PLAN_WALL);
  s.pairs[0].b = 2;
  plan_pair(&s, 1, 2);
  s.attached = 1;
  s.options.explore.draws = 100;
  const plan_outcome out = plan_run(&s);
  CHECK_EQ(out.result, NSVCD_OK);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  plan_scene carried = s;  // the second ball alone, above the first
  for (size_t j = 0; j < 3; j++) CHECK_EQ(carried.start[j], s.start[j]);
  oracle_mesh ball, wall;
  CHECK(oracle_mesh_init(&ball, plan_shapes[PLAN_BALL].positions, plan_shapes[PLAN_BALL].vertices,
                         plan_shapes[PLAN_BALL].indices, plan_shapes[PLAN_BALL].triangles, 1));
  CHECK(oracle_mesh_init(&wall, plan_shapes[PLAN_WALL].positions, plan_shapes[PLAN_WALL].vertices,
                         plan_shapes[PLAN_WALL].indices, plan_shapes[PLAN_WALL].triangles, 1));
  static oracle_pose poses[2][201];
  const oracle_pose at = plan_exact_pose(&s.rest[2]);
  for (int n = 0; n <= 200; n++) {
    float joints[3];
    nsvcd_pose placed[3];
    nsvcd_spline(out.control, out.via, 3, (float)n / 200, 0, joints);
    plan_place(&s, joints, placed);
    for (int b = 0; b < 2; b++) poses[b][n] = plan_exact_pose(&placed[b]);
  }
  for (int b = 0; b < 2; b++)
    CHECK_EQ(oracle_sweep(&ball, poses[b], 201, &wall, &at, NULL).status, ORACLE_FREE);
  oracle_mesh_free(&ball);
  oracle_mesh_free(&wall);
  // Let go: the second ball rests where the path is blocked no more, and the pair of both balls is
  // looked at.
  s.attached = 0;
  s.rest[1] = query_pose(0, 0.4, 0.45);
  plan_pair(&s, 0, 1);
  const plan_outcome alone = plan_run(&s);
  CHECK_EQ(alone.answer.status, NSVCD_PLAN_CONVERGED);
}

// A body of a shared shape, with triangles; it lives until the process ends.
static const nsvcd_body *plan_solid(int shape) {
  static const nsvcd_body *bodies[PLAN_SHAPES];
  if (bodies[shape]) return bodies[shape];
  plan_body(shape);  // makes the shape
  nsvcd_mesh flat = mesh_of(&plan_shapes[shape]);
  CHECK_EQ(nsvcd_encode(&flat, &query_both, NULL, NULL, 0, &bodies[shape]), NSVCD_OK);
  nsvcd_mesh_free(&flat, NULL);
  return bodies[shape];
}

// With triangles CONVERGED is a proof, and what is not free is not called so, whatever the search
// believed.
static void plan_proves_at_the_end(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  s.bodies[0] = plan_solid(PLAN_BALL);
  s.bodies[1] = plan_solid(PLAN_WALL);
  for (uint64_t seed = 1; seed <= 2; seed++) {
    s.options.seed = seed;
    const plan_outcome out = plan_run(&s);
    CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
    CHECK_EQ(out.answer.logit, -NSVCD_LOGIT_CERTAIN);
    CHECK_EQ(s.again, 0);
    CHECK_GE(plan_exact_distance(&s, &out, PLAN_BALL, PLAN_WALL), 1e-5);
  }
  // And at a distance, which the search knows nothing of: what it says has converged keeps that.
  size_t converged = 0;
  for (uint64_t seed = 1; seed <= 3; seed++) {
    s.options.seed = seed;
    s.options.sweep.clearance = 0.002f * (float)seed;
    const plan_outcome out = plan_run(&s);
    CHECK(out.answer.status == NSVCD_PLAN_CONVERGED ||
          (out.answer.status == NSVCD_PLAN_LIMIT && out.answer.collides));
    if (out.answer.status != NSVCD_PLAN_CONVERGED) continue;
    CHECK_GE(plan_exact_distance(&s, &out, PLAN_BALL, PLAN_WALL),
             (double)s.options.sweep.clearance - 1e-5);
    converged++;
  }
  CHECK_GE(converged, 1);
  s.options.sweep.clearance = 0;
  s.options.collision = -1;  // hits cost nothing: the search goes straight through
  const plan_outcome through = plan_run(&s);
  CHECK_EQ(through.answer.status, NSVCD_PLAN_LIMIT);
  CHECK(through.answer.collides);
  CHECK_GE(s.again, 3);
  CHECK_EQ(through.answer.logit, NSVCD_LOGIT_CERTAIN);
  CHECK_NEAR(through.answer.time, 0.5, 0.25);
}

// A proof that finds the ball inside of the box, at the one pose that is looked at, is as good a
// reason to search on as one that finds it in its surface.
static void plan_goes_on_after_a_proof_of_inside(void) {
  static plan_scene s;
  plan_begin(&s, PLAN_XYZ, 2);
  s.bodies[0] = plan_solid(PLAN_BALL);
  s.bodies[1] = plan_solid(PLAN_BOX);
  plan_pair(&s, 0, 1);
  s.start[0] = -0.4f;
  s.goal[0] = 0.4f;
  s.options.discrete = 1;
  s.options.explore.segments = s.options.refine.segments = s.options.check = 2;
  s.options.seeds = 1;
  s.options.collision = -1;  // hits cost nothing: the search goes straight through
  const plan_outcome through = plan_run(&s);
  CHECK_EQ(through.answer.status, NSVCD_PLAN_LIMIT);
  CHECK_EQ(through.answer.logit, NSVCD_LOGIT_CERTAIN);
  CHECK_NEAR(through.answer.time, 0.5, 1e-6);
  CHECK_GE(s.again, 3);
}

// Half a millimetre beside a wall, and along it: free, by proof and by the network.
static void plan_starts_beside_a_wall(void) {
  static plan_scene s;
  plan_begin(&s, PLAN_XYZ, 2);
  s.bodies[0] = plan_solid(PLAN_BOX);
  s.bodies[1] = plan_solid(PLAN_WALL);
  plan_pair(&s, 0, 1);
  s.start[0] = s.goal[0] = 0.1255f;
  s.start[1] = -0.08f;
  s.goal[1] = 0.08f;
  const plan_outcome proven = plan_run(&s);
  CHECK_EQ(proven.answer.status, NSVCD_PLAN_CONVERGED);
  CHECK_GE(plan_exact_distance(&s, &proven, PLAN_BOX, PLAN_WALL), 1e-4);
  s.options.sweep.method = NSVCD_METHOD_NETWORK;
  CHECK_EQ(plan_run(&s).answer.status, NSVCD_PLAN_CONVERGED);
  s.start[0] = s.goal[0] = 0.1245f;  // pressed in
  s.options.sweep.method = NSVCD_METHOD_PROOF;
  CHECK_EQ(plan_run(&s).answer.status, NSVCD_PLAN_START);
  s.bodies[0] = plan_body(PLAN_BOX);  // no triangles, no proof
  CHECK_EQ(plan_run(&s).result, NSVCD_ERROR_TRIANGLES);
}

static void plan_stages_can_be_left_out(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  s.options.refine.iterations = NSVCD_NONE;
  s.options.refine.via_points = 9;
  s.options.explore.via_points = 4;
  plan_outcome out = plan_run(&s);  // checks the number of via points
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  CHECK_GE(plan_exact_distance(&s, &out, PLAN_BALL, PLAN_WALL), 1e-4);
  memset(&s.options, 0, sizeof s.options);
  s.options.explore.iterations = NSVCD_NONE;
  s.options.refine.iterations = 40;
  out = plan_run(&s);
  CHECK_EQ(out.result, NSVCD_OK);
  CHECK_GE(s.reports, 1);
  s.options.refine.iterations = NSVCD_NONE;
  s.options.seeds = 1;  // nothing but the check of a line that hits
  out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_LIMIT);
  CHECK_EQ(out.answer.iterations, 0);
  CHECK(out.answer.collides && out.answer.pair == 0 && out.answer.logit > 0);
  CHECK_NEAR(out.answer.time, 0.5, 0.2);
  s.problem.pair_count = 0;  // nothing can meet: the smoothest, at once
  out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  for (size_t k = 0; k < out.via + 2; k++) {
    for (size_t j = 0; j < 3; j++) {  // monotone, and symmetric in time
      const double x = (double)out.control[3 * k + j];
      const double y = (double)out.control[3 * (out.via + 1 - k) + j];
      CHECK_NEAR(x + y, (double)s.start[j] + (double)s.goal[j], 1e-5);
      if (k) CHECK(out.control[3 * k] >= out.control[3 * k - 3] - 1e-6f);
    }
  }
}

static void plan_discrete_looks_at_poses(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  s.options.discrete = 1;
  plan_outcome out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  // Two segments: start, middle and goal. A wall between them is not seen, by design; swept it is.
  s.rest[1] = query_pose(-0.15, 0, 0);
  s.options.explore.iterations = s.options.refine.iterations = NSVCD_NONE;
  s.options.check = 2;
  s.options.seeds = 1;
  out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  s.options.discrete = 0;
  out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_LIMIT);
  CHECK(out.answer.collides);
  CHECK_NEAR(out.answer.time, 0.25, 0.12);  // in the first of two segments, not at its end
}

static void plan_takes_a_custom_cost(void) {
  static plan_scene s;
  for (int jacobian = 0; jacobian < 2; jacobian++) {
    plan_wall_scene(&s);
    s.problem.collision = plan_bump_collision;
    s.problem.bodies = NULL;
    s.problem.jacobian = jacobian ? plan_jacobian : NULL;
    const plan_outcome out = plan_run(&s);
    CHECK_EQ(out.result, NSVCD_OK);
    CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
    CHECK_EQ(out.answer.sweeps, 0);
    CHECK(out.answer.pair == NSVCD_NONE);
    for (int n = 0; n <= 200; n++) {
      float joints[3];
      nsvcd_pose placed[2];
      int collides = 0;
      nsvcd_spline(out.control, out.via, 3, (float)n / 200, 0, joints);
      plan_place(&s, joints, placed);
      plan_bump_collision(&s, placed, 1, INFINITY, &collides, NULL);
      CHECK(!collides);
    }
  }
}

// The joints at a time, and where a body is then as another sees it; in double.
static oracle_pose plan_seen(const plan_scene *s, const plan_outcome *out, nsvcd_body_pair pair,
                             double t) {
  double w[PLAN_VIA];
  double joints[PLAN_JOINTS] = {0};
  oracle_pose poses[PLAN_BODIES];
  nsvcd__spline_weights(out->via, t, 0, w);
  for (size_t k = 0; k < (out->via + 2) * s->problem.joints; k++)
    joints[k % s->problem.joints] += w[k / s->problem.joints] * (double)out->control[k];
  plan_place_exactly(s, joints, poses);
  oracle_pose to_b = {{0, 0, 0}, {0, 0, 0, 0}};
  const double origin[3] = {0, 0, 0};
  double away[3];
  for (int k = 0; k < 4; k++) to_b.rotation[k] = (k < 3 ? -1 : 1) * poses[pair.b].rotation[k];
  oracle_sub(origin, poses[pair.b].position, away);
  oracle_transform(&to_b, away, to_b.position);
  return oracle_compose(&to_b, &poses[pair.a]);
}

// How far a vertex of a pair's a is, at most, as b sees it, from where the check of so many segments
// has it: at some 3,000 times. shapes: of the bodies.
static double plan_exact_stray(const plan_scene *s, const plan_outcome *out, size_t check,
                               const int *shapes) {
  const size_t parts = 3000 / check + 2;
  double most = 0;
  for (size_t k = 0; k < s->problem.pair_count; k++) {
    const nsvcd_body_pair pair = s->pairs[k];
    const shapes_mesh *mesh = &plan_shapes[shapes[pair.a]];
    for (size_t n = 0; n < check * parts; n++) {
      const double begin = (double)(n / parts) / (double)check;
      const double fraction = (double)(n % parts) / (double)parts;
      const oracle_pose from = plan_seen(s, out, pair, begin);
      const oracle_pose to = plan_seen(s, out, pair, begin + 1.0 / (double)check);
      const oracle_pose checked = oracle_pose_between(&from, &to, fraction);
      const oracle_pose is = plan_seen(s, out, pair, begin + fraction / (double)check);
      for (size_t v = 0; v < mesh->vertices; v++) {
        double x[3], y[3], d[3];
        oracle_transform(&checked, mesh->positions + 3 * v, x);
        oracle_transform(&is, mesh->positions + 3 * v, y);
        oracle_sub(x, y, d);
        most = fmax(most, oracle_length(d));
      }
    }
  }
  return most;
}

// ------------------------------------------------------------------------------------------ errors

// A cost that draws the body far out of the limits of its first joint, but never collides.
static float plan_lure(void *user, const nsvcd_pose *poses, size_t samples, float limit,
                       int *collides, float *gradient) {
  const plan_scene *s = (const plan_scene *)user;
  const size_t stride = s->problem.body_count;
  double sum = 0;
  (void)limit;
  *collides = 0;
  for (size_t i = 0; i < samples; i++) {
    const double away = 3 - (double)poses[i * stride].position[0];
    sum += away * away;
    if (gradient) gradient[6 * i * stride] += (float)(-2 * away);
  }
  return (float)sum;
}

static void plan_refuses(plan_scene *s, nsvcd_result expected, int measured) {
  if (!measured) CHECK_EQ(nsvcd_plan_workspace_size(&s->problem, &s->options), 0);
  if (measured) CHECK(nsvcd_plan_workspace_size(&s->problem, &s->options) > 0);
  const plan_outcome out = plan_run(s);  // checks that nothing is written
  CHECK_EQ(out.result, expected);
}

static void plan_refuses_options_out_of_range(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  nsvcd_plan_options *o = &s.options;
  const nsvcd_plan_options none = *o;
  size_t *const sizes[] = {&o->explore.via_points,
                           &o->explore.segments,
                           &o->explore.iterations,
                           &o->explore.draws,
                           &o->refine.via_points,
                           &o->refine.segments,
                           &o->refine.iterations,
                           &o->refine.draws,
                           &o->seeds,
                           &o->check,
                           &o->sweep.network.pairs};
  const size_t most[] = {32,    4096, 100000, 10000,          32, 4096, 100000,
                         10000, 1000, 16384,  NSVCD_MAX_PAIRS};
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    *sizes[k] = most[k];
    o->check = o->check ? o->check : 10;
    CHECK(nsvcd_plan_workspace_size(&s.problem, o) > 0);
    for (int n = 0; n < 3; n++) {
      if (n == 2 && (k == 2 || k == 6)) continue;  // NSVCD_NONE
      *sizes[k] = n == 0 ? most[k] + 1 : n == 1 ? SIZE_MAX / 2 : SIZE_MAX;
      plan_refuses(&s,
                   k < 8    ? NSVCD_ERROR_STAGE
                   : k < 10 ? NSVCD_ERROR_PLAN
                            : NSVCD_ERROR_PAIRS,
                   0);
    }
    *o = none;
  }
  float *const floats[] = {&o->velocity,      &o->acceleration, &o->jerk,
                           &o->collision,     &o->duration,     &o->margin,
                           &o->explore.noise, &o->refine.noise, &o->sweep.network.recall};
  for (size_t k = 0; k < sizeof floats / sizeof *floats; k++) {
    const nsvcd_result code = k < 8 ? NSVCD_ERROR_PLAN : NSVCD_ERROR_RECALL;
    *floats[k] = NAN;
    plan_refuses(&s, code, 0);
    *floats[k] = -INFINITY;
    plan_refuses(&s, code, 0);
    *o = none;
  }
  o->sweep.network.recall = 0.5f;
  plan_refuses(&s, NSVCD_ERROR_RECALL, 0);
  *o = none, o->sweep.network.model = (nsvcd_model)17;
  plan_refuses(&s, NSVCD_ERROR_MODEL, 0);
  *o = none, o->sweep.network.precision = (nsvcd_precision)5;
  plan_refuses(&s, NSVCD_ERROR_PRECISION, 0);
}

static void plan_works_at_the_ends_of_its_options(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  nsvcd_plan_options *o = &s.options;
  o->explore.via_points = o->explore.segments = o->explore.iterations = o->explore.draws = 1;
  o->refine = o->explore;
  o->seeds = o->check = 1;
  plan_outcome out = plan_run(&s);
  CHECK_EQ(out.result, NSVCD_OK);
  o->explore.via_points = o->refine.via_points = 32;
  o->explore.segments = o->refine.segments = 300;
  o->check = 16384;
  out = plan_run(&s);
  CHECK_EQ(out.result, NSVCD_OK);
  memset(o, 0, sizeof *o);
  o->explore.via_points = 32;
  o->refine.via_points = 1;  // from more to fewer
  o->explore.draws = 30;
  out = plan_run(&s);
  CHECK_EQ(out.result, NSVCD_OK);
  o->refine.segments = 4096;  // of which the check could not have 16 times as many
  CHECK(nsvcd_plan_workspace_size(&s.problem, o) > 0);
}

static void plan_refuses_problems(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  const nsvcd_plan_problem good = s.problem;
  nsvcd_plan_problem *p = &s.problem;
  CHECK_EQ(nsvcd_plan_workspace_size(NULL, NULL), 0);
  static const nsvcd_result wanted[14] = {
      NSVCD_ERROR_COUNT,    NSVCD_ERROR_COUNT,    NSVCD_ERROR_ARGUMENT, NSVCD_ERROR_ARGUMENT,
      NSVCD_ERROR_ARGUMENT, NSVCD_ERROR_ARGUMENT, NSVCD_ERROR_ARGUMENT, NSVCD_ERROR_ARGUMENT,
      NSVCD_ERROR_ARGUMENT, NSVCD_ERROR_PAIR,     NSVCD_ERROR_COUNT,    NSVCD_ERROR_PAIR,
      NSVCD_ERROR_PAIR,     NSVCD_ERROR_ARGUMENT};
  for (int k = 0; k < 14; k++) {
    *p = good;
    if (k == 0) p->joints = 0;
    if (k == 1) p->joints = NSVCD_MAX_JOINTS + 1;
    if (k == 2) p->low = NULL;
    if (k == 3) p->high = NULL;
    if (k == 4) p->start = NULL;
    if (k == 5) p->goal = NULL;
    if (k == 6) p->bodies = NULL;
    if (k == 7) p->pairs = NULL;
    if (k == 8) p->kinematics = NULL;
    if (k == 9) p->body_count = 1;  // of which the pair's b is none
    if (k == 10) p->body_count = 65537;
    if (k == 11) s.pairs[0].b = 0;  // itself
    if (k == 12) s.pairs[0].b = 0xffffffffu;
    if (k == 13) s.bodies[1] = NULL;
    plan_refuses(&s, wanted[k], 0);
    s.pairs[0].b = 1;
  }
  plan_wall_scene(&s);
  const uint64_t text[2] = {0x7a7a7a7a7a7a7a7au, 0};
  const void *no_body = text;
  s.bodies[0] = (const nsvcd_body *)no_body;
  plan_refuses(&s, NSVCD_ERROR_BODY, 0);
  plan_wall_scene(&s);
  s.low[1] = 0.6f;  // above high
  plan_refuses(&s, NSVCD_ERROR_LIMITS, 1);
  const float wrong[4] = {NAN, INFINITY, -INFINITY, 2e6f};
  for (size_t k = 0; k < 16; k++) {
    plan_wall_scene(&s);
    float *const number = k < 4    ? &s.low[2]
                          : k < 8  ? &s.high[2]
                          : k < 12 ? &s.start[2]
                                   : &s.goal[2];
    *number = wrong[k % 4];
    plan_refuses(&s, NSVCD_ERROR_VALUE, 1);
  }
  for (int fault = PLAN_NAN; fault <= PLAN_NAN_LATER; fault++) {
    plan_wall_scene(&s);
    s.fault = (plan_fault)fault;
    const int is_long = fault == PLAN_LONG_QUATERNION;
    const nsvcd_result code = is_long ? NSVCD_ERROR_QUATERNION : NSVCD_ERROR_POSE;
    plan_refuses(&s, code, 1);
    s.problem.collision = plan_bump_collision;
    plan_refuses(&s, code, 1);
  }
  // Quaternions as long as nsvcd_sweep lets them be are not too long in pairs either.
  for (int n = 0; n < 2; n++) {
    plan_wall_scene(&s);
    s.length = n ? 1.00009 : 0.99991;
    const plan_outcome out = plan_run(&s);
    CHECK_EQ(out.result, NSVCD_OK);
    CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  }
  plan_wall_scene(&s);  // no pairs, no bodies
  s.problem.pair_count = 0;
  s.problem.pairs = NULL;
  s.problem.bodies = NULL;
  const plan_outcome out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
}

// --------------------------------------------------------------------------- a thousand bad scenes

typedef enum plan_trouble {
  PLAN_START_HITS,
  PLAN_START_OUT,
  PLAN_GOAL_HITS,
  PLAN_GOAL_OUT,
  PLAN_EXCLUDED,  // limits without width, away from the start
  PLAN_ENCLOSED,
  PLAN_SAME_BODY,
  PLAN_ZERO_LENGTH,
  PLAN_NO_WIDTH,  // limits of a joint that cannot move
  PLAN_NO_PAIRS,
  PLAN_CROWD,
  PLAN_ONE_VIA,
  PLAN_HUGE,
  PLAN_FAR,
  PLAN_TINY,
  PLAN_NEGATIVE,
  PLAN_EXTREME,
  PLAN_TROUBLES
} plan_trouble;

static const char *const plan_troubles[PLAN_TROUBLES] = {"start hits",
                                                         "start out of limits",
                                                         "goal hits",
                                                         "goal out of limits",
                                                         "limits exclude the start",
                                                         "enclosed",
                                                         "pair of one body",
                                                         "no length",
                                                         "limits without width",
                                                         "no pairs",
                                                         "32 bodies",
                                                         "one via point",
                                                         "huge",
                                                         "far",
                                                         "tiny",
                                                         "no weights",
                                                         "extreme weights"};

// Everything times `scale`: bodies, limits, start, goal.
static void plan_scale(plan_scene *s, float scale, query_memory *memory) {
  for (size_t b = 0; b < s->problem.body_count; b++) {
    const size_t size = nsvcd_body_describe(s->bodies[b]).size;
    memory[b] = query_reserve(size);
    CHECK_EQ(nsvcd_body_scale(s->bodies[b], (const float[3]){scale, scale, scale}, memory[b].at,
                              size, &s->bodies[b]),
             NSVCD_OK);
    for (int k = 0; k < 3; k++) s->rest[b].position[k] *= scale;
  }
  for (size_t j = 0; j < 3; j++) {
    s->low[j] *= scale;
    s->high[j] *= scale;
    s->start[j] *= scale;
    s->goal[j] *= scale;
  }
}

// Makes a scene of this trouble, plans, and checks what must come of it. Returns the status, or -1
// for an error.
static int plan_trouble_case(plan_trouble trouble, uint64_t seed) {
  static plan_scene s;
  shapes_rng rng = {1000 * seed + (uint64_t)trouble};
  query_memory scaled[2] = {{NULL, NULL}, {NULL, NULL}};
  const size_t joint = (size_t)shapes_pick(&rng, 3);
  plan_wall_scene(&s);
  s.rest[1] = query_pose(0, shapes_uniform(&rng, -0.2, 0.2), shapes_uniform(&rng, -0.2, 0.2));
  for (size_t j = 1; j < 3; j++) {
    s.start[j] = (float)shapes_uniform(&rng, -0.3, 0.3);
    s.goal[j] = (float)shapes_uniform(&rng, -0.3, 0.3);
  }
  nsvcd_plan_options *o = &s.options;
  o->seed = seed;
  o->seeds = 1 + (size_t)shapes_pick(&rng, 2);
  o->explore.iterations = 4;
  o->explore.draws = 12;
  o->explore.segments = 8;
  o->explore.via_points = 3;
  o->refine.iterations = 3;
  o->refine.draws = 2;
  o->refine.segments = 10;
  o->refine.via_points = 4;
  if (trouble == PLAN_START_HITS || trouble == PLAN_GOAL_HITS) {
    s.problem.body_count = 3;
    s.bodies[2] = plan_body(PLAN_BOX);
    const float *at = trouble == PLAN_START_HITS ? s.start : s.goal;
    s.rest[2] =
        query_pose((double)at[0] + shapes_uniform(&rng, -0.08, 0.08), (double)at[1], (double)at[2]);
    plan_pair(&s, 0, 2);
  }
  if (trouble == PLAN_START_OUT) s.start[joint] = (float)shapes_uniform(&rng, 0.51, 3);
  if (trouble == PLAN_GOAL_OUT) {  // and something near the start, which is not the reason
    s.goal[joint] = (float)shapes_uniform(&rng, -3, -0.51);
    s.problem.body_count = 3;
    s.bodies[2] = plan_body(PLAN_BOX);
    s.rest[2] = query_pose((double)s.start[0] - 0.18, (double)s.start[1], (double)s.start[2]);
    plan_pair(&s, 0, 2);
  }
  if (trouble == PLAN_EXCLUDED) s.low[joint] = s.high[joint] = s.start[joint] + 1e-3f;
  if (trouble == PLAN_ENCLOSED) {
    s.bodies[1] = plan_body(PLAN_SHELL);
    for (size_t j = 0; j < 3; j++) {
      s.low[j] = -2;
      s.high[j] = 2;
      s.goal[j] = s.rest[1].position[j];
      s.start[j] = s.goal[j] + (j == joint ? 0.6f : 0);
    }
    o->sweep.network.recall = 0.999f;
  }
  if (trouble == PLAN_SAME_BODY) s.pairs[0].a = s.pairs[0].b = (uint32_t)shapes_pick(&rng, 2);
  if (trouble == PLAN_ZERO_LENGTH) memcpy(s.goal, s.start, sizeof s.goal);
  if (trouble == PLAN_NO_WIDTH) {  // y, at a distance; what cannot move stays where it is
    const float at = (float)(shapes_uniform(&rng, 1, 9) * pow(10, shapes_pick(&rng, 5)));
    s.low[1] = s.high[1] = s.start[1] = s.goal[1] = at;
  }
  if (trouble == PLAN_NO_PAIRS) s.problem.pair_count = 0;
  if (trouble == PLAN_CROWD) {
    s.problem.body_count = PLAN_BODIES;
    for (uint32_t b = 2; b < PLAN_BODIES; b++) {
      s.bodies[b] = plan_body(shapes_pick(&rng, PLAN_SHAPES));
      query_random_pose(&rng, 1.5, &s.rest[b]);
      plan_pair(&s, 0, b);
      plan_pair(&s, b, (uint32_t)shapes_pick(&rng, 2));
    }
  }
  if (trouble == PLAN_ONE_VIA) o->explore.via_points = o->refine.via_points = 1;
  if (trouble == PLAN_HUGE) {
    plan_scale(&s, 1e5f, scaled);
    o->explore.noise = 5e4f;
    o->refine.noise = 1e3f;
  }
  if (trouble == PLAN_TINY) {
    plan_scale(&s, 1e-6f, scaled);
    o->explore.noise = 5e-7f;
    o->refine.noise = 1e-8f;
  }
  if (trouble == PLAN_FAR) {
    for (size_t j = 0; j < 3; j++) {
      s.low[j] += 1e5f;
      s.high[j] += 1e5f;
      s.start[j] += 1e5f;
      s.goal[j] += 1e5f;
      s.rest[1].position[j] += 1e5f;
    }
  }
  float *const weights[] = {&o->velocity, &o->acceleration,  &o->jerk,         &o->collision,
                            &o->margin,   &o->explore.noise, &o->refine.noise, &o->duration};
  const float extremes[] = {1e20f, 1e-20f, -1, 1e30f, 3e38f, 1e-38f, 0, 1e5f};
  for (size_t k = 0; k < 8; k++) {
    if (trouble == PLAN_NEGATIVE) *weights[k] = (float)shapes_uniform(&rng, -10, -1e-3);
    if (trouble == PLAN_EXTREME && (seed % 8 == k || shapes_pick(&rng, 3) == 0))
      *weights[k] = extremes[shapes_pick(&rng, 8)];
  }
  const plan_outcome out = plan_run(&s);  // bounds, numbers, guards
  const plan_outcome again = plan_run(&s);
  const nsvcd_plan_answer *a = &out.answer;
  CHECK_EQ(out.result, again.result);
  if (!out.result) CHECK(plan_same(&out, &again, 3));
  for (int b = 0; b < 2; b++) query_release(&scaled[b]);
  if (trouble == PLAN_SAME_BODY) {
    CHECK_EQ(out.result, NSVCD_ERROR_PAIR);
    return -1;
  }
  // the cost is beyond float's range
  if (trouble == PLAN_EXTREME && out.result == NSVCD_ERROR_NUMBER) return -1;
  CHECK_EQ(out.result, NSVCD_OK);
  if (out.result) return -1;
  if (trouble == PLAN_START_HITS || trouble == PLAN_GOAL_HITS) {
    CHECK_EQ(a->status, trouble == PLAN_START_HITS ? NSVCD_PLAN_START : NSVCD_PLAN_GOAL);
    CHECK(a->pair == 1 && a->collides && a->logit > 0 && a->joint == NSVCD_NONE);
    CHECK_EQ(a->time, trouble == PLAN_GOAL_HITS);
  }
  if (trouble == PLAN_START_OUT || trouble == PLAN_GOAL_OUT || trouble == PLAN_EXCLUDED) {
    CHECK_EQ(a->status, trouble == PLAN_GOAL_OUT ? NSVCD_PLAN_GOAL : NSVCD_PLAN_START);
    CHECK(a->joint == joint && a->pair == NSVCD_NONE && !a->collides);
  }
  if (trouble <= PLAN_EXCLUDED && trouble != PLAN_ENCLOSED)
    CHECK(a->iterations == 0 && s.reports == 0 && a->seeds == 0);
  if (trouble == PLAN_ENCLOSED) CHECK(a->status == NSVCD_PLAN_LIMIT && a->collides && a->pair == 0);
  if (trouble == PLAN_ZERO_LENGTH || trouble == PLAN_NO_WIDTH || trouble == PLAN_NO_PAIRS) {
    CHECK_EQ(a->status, NSVCD_PLAN_CONVERGED);
  }
  if (trouble == PLAN_ZERO_LENGTH) CHECK_LE(a->smoothness, 1e-6);
  for (size_t k = 0; trouble == PLAN_NO_WIDTH && k < out.via + 2; k++)
    CHECK_NEAR(out.control[3 * k + 1], s.low[1], 1e-6 * (double)s.low[1]);
  return (int)a->status;
}

static void plan_troubles_end_well(void) {
  const uint64_t each = check_many(12);
  int total = 0;
  for (int trouble = 0; trouble < PLAN_TROUBLES; trouble++) {
    int count[6] = {0};
    for (uint64_t seed = 1; seed <= each; seed++) {
      count[1 + plan_trouble_case((plan_trouble)trouble, seed)]++;
      total++;
    }
    printf("  %-26s", plan_troubles[trouble]);
    for (int k = 0; k < 6; k++) {
      if (count[k])
        printf("%4d %s", count[k],
               k ? nsvcd_plan_status_string((nsvcd_plan_status)(k - 1)) : "error");
    }
    printf("\n");
    CHECK_EQ(count[1 + NSVCD_PLAN_CANCELLED], 0);
  }
  CHECK_EQ(total, (int)each * PLAN_TROUBLES);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

static void plan_gradient_of_the_cost(void) {
  for (int jacobian = 0; jacobian < 2; jacobian++) {
    double worst[2] = {0, 0};
    for (int limits = 0; limits < 2; limits++) {
      plan_gradient_case(PLAN_XYZ, jacobian, limits, &worst[limits]);
      plan_gradient_case(PLAN_ARMS, jacobian, limits, &worst[limits]);
    }
    printf("  %s: off by %.1e at most, %.1e with limits\n",
           jacobian ? "jacobian" : "differences of place()", worst[0], worst[1]);
  }
}

static void plan_gradient_of_the_network(void) {
  static const char *const names[2] = {"a ball past a box", "two arms and a box"};
  for (int kind = 0; kind < 2; kind++) {
    int tried = 0;
    int smooth = 0;
    int right = 0;
    double worst = 0;
    plan_network_gradient_case(kind ? PLAN_ARMS : PLAN_XYZ, &tried, &smooth, &right, &worst);
    printf(
        "  %s: %d trajectories that cost, %d smooth there, of these %d right to 3 %%, worst %.2g\n",
        names[kind], tried, smooth, right, worst);
    CHECK_GE(smooth, 30);
    CHECK_GE(right, 0.9 * smooth);
  }
}

// The bundle's gradient is the mean over its offsets.
static void plan_bundled_gradient_is_a_mean(void) {
  static plan_scene s;
  plan_inside in;
  shapes_rng rng = {22};
  plan_begin(&s, PLAN_ARMS, 4);
  s.problem.collision = plan_bump_collision;
  s.rest[3] = query_pose(0.2, 0.1, 0.05);
  plan_pair(&s, 0, 2);
  plan_pair(&s, 1, 3);
  if (!plan_open(&s, &in)) return;
  nsvcd__planner *p = &in.planner;
  const nsvcd__stage *stage = &p->refine;
  const size_t f = 5;
  const size_t numbers = stage->via * f;
  float control[PLAN_VIA * PLAN_JOINTS], moved[PLAN_VIA * PLAN_JOINTS],
      gradient[PLAN_VIA * PLAN_JOINTS];
  double sum[PLAN_VIA * PLAN_JOINTS] = {0};
  double norm = 0;
  double difference = 0;
  double spread = 0;
  plan_random_numbers(&rng, numbers + 2 * f, 0.3, control);
  plan_random_numbers(&rng, stage->draws * numbers, 0.2, p->drawn);
  for (size_t n = 0; n < stage->draws; n++) {
    memcpy(moved, control, sizeof moved);
    for (size_t k = 0; k < numbers; k++) moved[f + k] += p->drawn[n * numbers + k];
    nsvcd__cost_of(p, stage, moved, INFINITY, gradient);
    for (size_t k = 0; k < numbers; k++) sum[k] += (double)gradient[f + k] / (double)stage->draws;
  }
  nsvcd__cost_of(p, stage, control, INFINITY, gradient);
  nsvcd__bundled_gradient(p, stage, control);
  for (size_t k = 0; k < numbers; k++) {
    norm += sum[k] * sum[k];
    difference += pow(sum[k] - (double)p->sum[k], 2);
    spread += pow(sum[k] - (double)gradient[f + k], 2);
  }
  CHECK_LE(sqrt(difference), 1e-5 * sqrt(norm));
  CHECK_GE(sqrt(spread), 0.01 * sqrt(norm));  // else the offsets would not matter
  plan_close(&in);
}

// L-BFGS alone on a smooth cost comes close to the minimum in a few iterations.
static void plan_refining_converges(void) {
  static plan_scene s;
  double worst = 0;
  for (int n = 0; n < 10; n++) {
    float cost[2] = {0, 0};
    for (int longer = 0; longer < 2; longer++) {
      plan_begin(&s, PLAN_XYZ, 2);
      plan_inside in;
      s.problem.collision = plan_bump_collision;
      s.problem.jacobian = plan_jacobian;
      s.problem.progress = NULL;
      s.start[0] = -0.5f;
      s.goal[0] = 0.5f;
      s.rest[1] = query_pose(0.05 * n - 0.2, 0.03 + 0.01 * n, 0.05);
      plan_pair(&s, 0, 1);
      s.options.explore.iterations = NSVCD_NONE;
      s.options.refine.iterations = longer ? 300 : 12;
      s.options.refine.draws = 1;
      s.options.refine.noise = -1;
      s.options.collision = 1;
      if (!plan_open(&s, &in)) return;
      nsvcd__smoothest(&in.planner, &in.planner.refine, in.planner.best);
      nsvcd__refine(&in.planner);
      cost[longer] =
          nsvcd__cost_of(&in.planner, &in.planner.refine, in.planner.best, INFINITY, NULL).total;
      CHECK_EQ(in.planner.error, NSVCD_OK);
      plan_close(&in);
    }
    worst = fmax(worst, (double)(cost[0] / cost[1] - 1));
  }
  printf("  after 12 iterations at most %.1e of the cost above that after 300\n", worst);
  CHECK_LE(worst, 0.01);
}

static void plan_culling_misses_nothing(void) {
  static plan_scene s;
  shapes_rng rng = {30};
  plan_inside in;
  int segments = 0;
  int uncertain = 0;
  int missed = 0;
  int missed_by_network = 0;
  int culled = 0;
  plan_begin(&s, PLAN_XYZ, 6);
  const int shapes[6] = {PLAN_OFF_CENTRE, PLAN_BALL, PLAN_OFF_CENTRE,
                         PLAN_BOX,        PLAN_WALL, PLAN_LINK};
  for (size_t b = 0; b < 6; b++) s.bodies[b] = plan_body(shapes[b]);
  for (uint32_t a = 0; a < 6; a++) {
    for (uint32_t b = 0; b < 6; b++) {
      if (a != b) plan_pair(&s, a, b);
    }
  }
  if (!plan_open(&s, &in)) return;
  nsvcd__planner *p = &in.planner;
  for (int n = 0; n < 1500; n++) {
    const size_t samples = 9;
    plan_random_poses(&rng, p, samples, shapes_uniform(&rng, 0.1, 1),
                      n % 3 == 0   ? 0.1
                      : n % 3 == 1 ? 0.6
                                   : 2);
    // far off, and rounded
    for (size_t i = 0; n % 5 == 0 && i < samples * 6; i++) p->poses[i].position[1] += 1e5f;
    nsvcd__find_stances(p, samples);
    for (uint32_t k = 0; k < s.problem.pair_count; k++) {
      for (size_t stride = 0; stride < 2; stride++) {
        nsvcd__find_meetings(p, &s.problem.pairs[k], samples, stride);
        for (size_t i = 0; i + stride < samples; i++) {
          const nsvcd_answer answer = nsvcd__ask_segments(p, k, i, stride, 0, NULL);
          const int certain = status_of(&answer) == STATUS_CERTIFIED_FREE;
          segments++;
          uncertain += !certain;
          culled += !p->meets[i];
          missed += !certain && !p->meets[i];
          missed_by_network += logit_of(&answer) > -2 && !p->meets[i];
        }
      }
    }
  }
  printf(
      "  of %d segments %d are not certified free, %d culled, of which %d not certified free, %d "
      "suspicious\n",
      segments, uncertain, culled, missed, missed_by_network);
  CHECK_EQ(p->error, NSVCD_OK);
  CHECK_EQ(missed, 0);
  CHECK_GE(culled, 0.2 * (segments - uncertain));  // else it culls nothing
  CHECK_GE(uncertain, 1000);
  plan_close(&in);
}

// The collision cost of a trajectory is the sum over pairs and segments, as if nothing were culled;
// but for the segments of a run that as one motion is answered at most -margin: these count as
// free. So it is never more than the sum.
static void plan_cost_is_the_sum_over_segments(void) {
  static plan_scene s;
  shapes_rng rng = {31};
  plan_inside in;
  int equal = 0;
  int total = 0;
  int dropped = 0;
  int dropped_hits = 0;
  int costly = 0;
  plan_arms_scene(&s);
  plan_pair(&s, 0, 3);
  plan_pair(&s, 2, 0);
  if (!plan_open(&s, &in)) return;
  nsvcd__planner *p = &in.planner;
  const nsvcd__stage *stage = &p->refine;
  for (int n = 0; n < 400; n++) {
    float control[PLAN_VIA * PLAN_JOINTS], gradient[PLAN_VIA * PLAN_JOINTS], slope;
    double sum = 0;
    double without = 0;
    int collides = 0;
    int collides_at_all = 0;
    int dropped_here = 0;
    plan_random_numbers(&rng, (stage->via + 2) * s.problem.joints, 0.6, control);
    const nsvcd__cost cost = nsvcd__cost_of(p, stage, control, INFINITY, NULL);
    const nsvcd__cost again = nsvcd__cost_of(p, stage, control, INFINITY, gradient);
    CHECK_NEAR(cost.collision, again.collision, 1e-5 * (double)cost.collision);
    CHECK_EQ(cost.collides, again.collides);
    for (uint32_t k = 0; k < s.problem.pair_count; k++) {
      unsigned char meets[64] = {0};
      unsigned char runs[64];
      nsvcd__find_meetings(p, &s.pairs[k], stage->moments, 1);
      memcpy(meets, p->meets, stage->moments > 1 ? stage->moments - 1 : 0);
      memset(runs, 0, sizeof runs);
      for (size_t i = 0; i + 1 < stage->moments;) {  // which runs are clear
        size_t length = 0;
        while (length < 8 && i + length + 1 < stage->moments && meets[i + length]) length++;
        if (length > 1) {
          const nsvcd_answer run = nsvcd__ask_segments(p, k, i, length, 0, NULL);
          memset(runs + i, logit_of(&run) <= -p->options.margin, length);
        }
        i += length ? length : 1;
      }
      for (size_t i = 0; i + 1 < stage->moments; i++) {
        const nsvcd_answer answer = nsvcd__ask_segments(p, k, i, 1, 0, NULL);
        const double fraction =
            (double)nsvcd__cost_of_logit(logit_of(&answer), p->options.margin, &slope);
        sum += fraction;
        collides_at_all |= collides_of(&answer);
        costly += fraction > 0;
        if (!meets[i]) CHECK_EQ(fraction, 0);
        if (runs[i]) {
          without += fraction;
          dropped += fraction > 0;
          dropped_hits += collides_of(&answer);
          dropped_here += fraction > 0;
        } else {
          collides |= collides_of(&answer);
        }
      }
    }
    CHECK_NEAR(cost.collision, sum - without, 1e-5 * sum + 1e-6);
    CHECK_EQ(cost.collides, collides);
    CHECK(cost.collides <= collides_at_all);
    total++;
    equal += !dropped_here;
  }
  printf(
      "  %d of %d trajectories cost the sum; of %d segments that cost, %d (%d collide) lie in runs "
      "that do not\n",
      equal, total, costly, dropped, dropped_hits);
  CHECK_EQ(p->error, NSVCD_OK);
  CHECK_GE(equal, 0.8 * total);
  CHECK_GE(costly, 500);
  plan_close(&in);
}

// A sum that exceeds the limit is cut short, never one below it.
static void plan_cost_stops_at_its_limit(void) {
  static plan_scene s;
  shapes_rng rng = {32};
  plan_inside in;
  int cut = 0;
  plan_arms_scene(&s);
  if (!plan_open(&s, &in)) return;
  nsvcd__planner *p = &in.planner;
  for (int n = 0; n < 200; n++) {
    float control[PLAN_VIA * PLAN_JOINTS];
    plan_random_numbers(&rng, (p->refine.via + 2) * s.problem.joints, 0.5, control);
    const nsvcd__cost whole = nsvcd__cost_of(p, &p->refine, control, INFINITY, NULL);
    const float limit = whole.total * (float)shapes_uniform(&rng, 0.1, 2);
    const nsvcd__cost cost = nsvcd__cost_of(p, &p->refine, control, limit, NULL);
    if (whole.total < 0.9999f * limit)
      CHECK_NEAR(cost.total, whole.total, 1e-5 * (double)whole.total);
    if (whole.total > 1.0001f * limit) CHECK_GE(cost.total, limit);
    cut += cost.total < 0.999f * whole.total;
  }
  CHECK_GE(cut, 20);
  plan_close(&in);
}

// Where the first trajectory is free and none that is drawn is any better, exploring ends soon.
static void plan_stops_exploring_when_nothing_gets_better(void) {
  static plan_scene s;
  plan_wall_scene(&s);
  s.rest[1] = query_pose(0, 0, 5);
  s.options.refine.iterations = NSVCD_NONE;
  const plan_outcome out = plan_run(&s);
  CHECK_EQ(out.answer.status, NSVCD_PLAN_CONVERGED);
  CHECK_EQ(out.answer.iterations, NSVCD__PATIENCE);
}

// What an answer says that the spline strays from the last check is what the vertices stray, but
// for places not looked at (less) and for the sphere about a long body (more). By default it is
// below 0.2 mm. Three arms swing, one of them off its origin; in a pair both move, or one does.
static void plan_strays_as_far_as_it_says(void) {
  static plan_scene s;
  static const int shapes[4] = {PLAN_LINK, PLAN_LINK, PLAN_OFF_CENTRE, PLAN_BOX};
  static const size_t checks[6] = {0, 1, 2, 7, 24, 96};
  static const nsvcd_body_pair pairs[3] = {{1, 2}, {2, 0}, {1, 3}};
  double most[6] = {0};
  double ratio[2] = {HUGE_VAL, 0};
  shapes_rng rng = {31};
  plan_begin(&s, PLAN_ARMS, 4);
  for (size_t b = 0; b < 4; b++) s.bodies[b] = plan_body(shapes[b]);
  s.problem.collision = plan_bump_collision;
  s.rest[3] = query_pose(0, 0, -2);
  plan_pair(&s, 0, 0);
  s.options.explore.iterations = 3;
  s.options.explore.draws = s.options.seeds = 4;
  for (size_t n = 0; n < check_many(36); n++) {
    const size_t c = n % 6;
    s.pairs[0] = pairs[n / 6 % 3];
    for (size_t j = 0; c == 0 && j < 5; j++) {
      s.start[j] = (float)shapes_uniform(&rng, -1.6, 0);
      s.goal[j] = (float)shapes_uniform(&rng, 0, 1.6);
    }
    s.options.check = checks[c];
    const plan_outcome out = plan_run(&s);
    CHECK_EQ(out.result, NSVCD_OK);
    CHECK(out.answer.seeds > 0);
    const double exact = plan_exact_stray(&s, &out, checks[c] ? checks[c] : 384, shapes);
    const double stray = (double)out.answer.deviation;
    most[c] = fmax(most[c], exact);
    ratio[0] = fmin(ratio[0], stray / exact);
    ratio[1] = fmax(ratio[1], stray / exact);
  }
  printf(
      "  %.3f mm by default; in 1, 2, 7, 24 and 96 segments %.0f, %.0f, %.1f, %.2f, %.3f; said "
      "%.3f to %.3f times as much\n",
      1e3 * most[0], 1e3 * most[1], 1e3 * most[2], 1e3 * most[3], 1e3 * most[4], 1e3 * most[5],
      ratio[0], ratio[1]);
  CHECK_LE(most[0], 2e-4);
  CHECK_GE(most[5], 2e-4);  // else the default need not be so fine
  for (int c = 1; c < 5; c++) CHECK_GE(most[c], 2 * most[c + 1]);
  CHECK_GE(ratio[0], 0.98);
  CHECK_LE(ratio[1], 1.6);
  s.problem.bodies = NULL;  // of which nothing is known
  CHECK_EQ(plan_run(&s).answer.deviation, 0);
  s.problem.bodies = s.bodies;
  s.start[0] = 3;  // out of its limits
  CHECK_EQ(plan_run(&s).answer.deviation, 0);
}

// Between coarse moments a trajectory may leave its limits unseen; its via points do not.
static void plan_via_points_keep_the_limits(void) {
  static plan_scene s;
  plan_begin(&s, PLAN_XYZ, 1);
  s.problem.collision = plan_lure;
  s.start[0] = -0.5f;
  s.goal[0] = 1.8f;
  s.options.seeds = 1;
  s.options.velocity = s.options.acceleration = s.options.jerk = 0.01f;
  s.options.explore.draws = 40;
  size_t converged = 0;
  for (size_t n = 0; n < 125; n++) {
    s.options.explore.segments = 1 + n % 5;
    s.options.refine.segments = 1 + n / 5 % 5;
    s.options.check = 1 + n / 25;
    const plan_outcome out = plan_run(&s);
    CHECK_EQ(out.result, NSVCD_OK);
    converged += out.answer.status == NSVCD_PLAN_CONVERGED;
  }
  printf("  %zu of 125 coarse plans converged\n", converged);
  CHECK_GE(converged, 50);

  // Nor is a trajectory called free whose via points leave them between the moments.
  plan_inside in;
  float control[12 * PLAN_JOINTS];
  CHECK(plan_open(&s, &in));
  nsvcd__planner *p = &in.planner;
  p->check.moments = 2;
  nsvcd__stage_init(&p->options, &p->check);
  nsvcd__smoothest(p, &p->refine, control);
  const nsvcd__cost within = nsvcd__cost_of(p, &p->check, control, INFINITY, NULL);
  CHECK(nsvcd__is_free(&within));
  for (size_t k = 3; k < 33; k++) {
    const float kept = control[k];
    control[k] = k % 2 ? 2.001f : -2.001f;
    const nsvcd__cost beyond = nsvcd__cost_of(p, &p->check, control, INFINITY, NULL);
    CHECK_EQ(beyond.joint, k % 3);
    control[k] = kept;
  }
  plan_close(&in);
}

// A problem for which some 4 GB of memory would be needed: as many bytes, or none where size_t
// cannot count them.
static void plan_sizes_do_not_wrap(void) {
  static plan_scene s;
  static const nsvcd_body *bodies[2260];
  plan_wall_scene(&s);
  for (size_t k = 0; k < 2260; k++) bodies[k] = s.problem.bodies[k % s.problem.body_count];
  s.problem.bodies = bodies;
  s.problem.body_count = 2260;
  s.options.check = 16384;
  const size_t size = nsvcd_plan_workspace_size(&s.problem, &s.options);
  const double least =
      16385.0 * 2260 * (sizeof(nsvcd_pose) + sizeof(nsvcd__stance) + 6 * sizeof(float));
  if (least > (double)SIZE_MAX) CHECK_EQ(size, 0);
  if (least < (double)SIZE_MAX) CHECK_LE(least, size);
  float control[12 * 3];
  nsvcd_plan_answer answer;
  query_memory memory = query_reserve(4096);
  const nsvcd_result expected = size == 0 ? NSVCD_ERROR_TOO_LARGE : NSVCD_ERROR_WORKSPACE;
  CHECK_EQ(nsvcd_plan(&s.problem, &s.options, memory.at, 4096, control, &answer), expected);
  query_release(&memory);
}

// Steps of differences are no smaller than floats: far from zero the gradient is still that of the
// jacobian.
static void plan_differences_work_far_from_zero(void) {
  static plan_scene s;
  shapes_rng rng = {40};
  for (int n = 0; n < 20; n++) {
    const float far = (float)pow(10, n % 6);
    float control[12 * 3], gradient[2][12 * 3];
    double norm = 0;
    double difference = 0;
    plan_random_numbers(&rng, 36, 0.3, control);
    for (size_t k = 0; k < 36; k++) control[k] += far;
    for (int jacobian = 0; jacobian < 2; jacobian++) {
      plan_inside in;
      plan_begin(&s, PLAN_XYZ, 2);
      for (size_t j = 0; j < 3; j++) {
        s.low[j] = -1e6f;
        s.high[j] = 1e6f;
      }
      s.rest[1] = query_pose((double)far, (double)far, (double)far);
      s.problem.collision = plan_bump_collision;
      s.problem.jacobian = jacobian ? plan_jacobian : NULL;
      plan_pair(&s, 0, 1);
      if (!plan_open(&s, &in)) return;
      nsvcd__cost_of(&in.planner, &in.planner.refine, control, INFINITY, gradient[jacobian]);
      CHECK_EQ(in.planner.error, NSVCD_OK);
      plan_close(&in);
    }
    for (size_t k = 0; k < 36; k++) {
      norm += pow((double)gradient[1][k], 2);
      difference += pow((double)gradient[1][k] - (double)gradient[0][k], 2);
    }
    CHECK_LE(sqrt(difference), 0.01 * sqrt(norm));
  }
}

void test_optimizer(void) {
  RUN(plan_goes_round_a_wall);
  RUN(plan_defaults_are_what_is_written);
  RUN(plan_keeps_the_best_of_its_seeds);
  RUN(plan_grasped_bodies_move_along);
  RUN(plan_proves_at_the_end);
  RUN(plan_goes_on_after_a_proof_of_inside);
  RUN(plan_starts_beside_a_wall);
  RUN(plan_stages_can_be_left_out);
  RUN(plan_discrete_looks_at_poses);
  RUN(plan_takes_a_custom_cost);
  RUN(plan_refuses_options_out_of_range);
  RUN(plan_works_at_the_ends_of_its_options);
  RUN(plan_refuses_problems);
  RUN(plan_troubles_end_well);
  // from within
  RUN(plan_gradient_of_the_cost);
  RUN(plan_gradient_of_the_network);
  RUN(plan_bundled_gradient_is_a_mean);
  RUN(plan_refining_converges);
  RUN(plan_culling_misses_nothing);
  RUN(plan_cost_is_the_sum_over_segments);
  RUN(plan_cost_stops_at_its_limit);
  RUN(plan_stops_exploring_when_nothing_gets_better);
  RUN(plan_strays_as_far_as_it_says);
  RUN(plan_via_points_keep_the_limits);
  RUN(plan_sizes_do_not_wrap);
  RUN(plan_differences_work_far_from_zero);
}

CHECK_ALONE(test_optimizer)
