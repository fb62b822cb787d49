// In: a problem and options. Out: a planner, laid out in the caller's workspace. The rooms of this
// floor, each of which uses those before it:
//
//   spline      control points -> joints along a trajectory, and their derivatives
//   problem     checks, defaults, memory
//   culling     which bodies may meet in which segments; poses along a trajectory -> cost of
//               collision, and its derivative by the poses (wrenches)
//   cost        control points -> smoothness + limits + collision, and the derivative by the
//               control points
//   explore     MPPI: smooth random changes of a mean, weighted by exp(-cost / temperature)
//   refine      L-BFGS with bundled gradients, in the metric of the smoothness
//   plan        start and goal, several seeds, and the last check
//
// The planner asks as any program does, by the public functions. Of the private ones of query and
// motion it uses nsvcd__settings_of, nsvcd__poses_check and nsvcd__is_aligned, to refuse what a
// query would refuse, and nsvcd__world_pose_between.
//
// A trajectory is sampled at *moments*, uniform in t, both ends among them; a *segment* lies
// between two of them. A *rollout* is one of MPPI's random trajectories; a *bundle* is the random
// changes over which L-BFGS averages a gradient. Letters of shapes: M via points, F joints, B
// bodies, P pairs.
#pragma once
#include "../ground/memory.h"
#include "../ground/rotations.h"
#include "../query/question.h"
#include "spline.h"

#ifndef NSVCD_NO_OPTIMIZER
// Cost of joints beyond their limits, per radian^2 or metre^2, averaged over the moments.
#define NSVCD__LIMIT_COST 1e5f
// That cost begins this share of a joint's range before the limit.
#define NSVCD__LIMIT_MARGIN 0.005f
// Balls of patches grow by this share of their radii in the search:
// nsvcd_network_options.inflate.
#define NSVCD__PLAN_INFLATE 0.25f
// Logits over which the slope of the cost of collision grows from 0 to 1.
#define NSVCD__SOFT_LOGITS 2
// Segments that one query may rule out together.
#define NSVCD__RUN_SEGMENTS 8
// A joint's step for differences: a constant, and a share of its value.
#define NSVCD__JOINT_STEP 1e-3f
#define NSVCD__JOINT_STEP_FRACTION 1e-6f
// MPPI: a rollout this many temperatures above the least cost weighs nothing.
#define NSVCD__WEIGHTLESS 10
// MPPI: the temperature is such that one in this many rollouts is within two of the least cost.
#define NSVCD__ELITE 10
// MPPI: the mean moves by this share towards the rollouts' mean.
#define NSVCD__MEAN_STEP 0.9f
// MPPI: ends after this many iterations without a gain of 1 %, once the best is free.
#define NSVCD__PATIENCE 3
// L-BFGS: steps that are remembered, and step lengths that are tried.
#define NSVCD__HISTORY 8
#define NSVCD__STEPS 5
// Further refinements, each with a wider margin, while the proof finds hits.
#define NSVCD__RETRIES 3
// Segments of the last check for each of the finest stage.
#define NSVCD__CHECKS 16
// Times, at least, at which the deviation of a piece of the spline is measured.
#define NSVCD__DEVIATION_SAMPLES 16

// A body, in its own axes: its bounding sphere, and the box of its patches.
typedef struct nsvcd__shape {
  nsvcd__sphere sphere;
  nsvcd__box box;
} nsvcd__shape;

// A body at a moment.
typedef struct nsvcd__stance {
  nsvcd__transform pose;
  // of its bounding sphere, from its origin, in the world's axes
  nsvcd__f3 centre;
  // sqrt(1 - cos(h)), if it turns by 2 h until the next moment
  float bend;
} nsvcd__stance;

// How trajectories are sampled and searched: exploring, refining, or in the last check.
typedef struct nsvcd__stage {
  size_t via, moments;  // M; segments + 1
  size_t numbers;       // M F
  size_t bytes;         // of all control points
  size_t iterations;
  size_t draws;      // rollouts of an iteration, or gradients in a bundle
  float noise;       // their standard deviation, radians or metres
  double *form;      // (M + 2, M + 2): smoothness
  double *factor;    // (M, M): Cholesky's, of the via points' rows and columns
  double deviation;  // the largest of a via point, of factor^-T times normal numbers
  float *weights;    // (moments, M + 2): of the control points, in the joints
} nsvcd__stage;

// What a trajectory costs.
typedef struct nsvcd__cost {
  float total, smoothness, collision;
  int collides;  // at the moments or in the segments that were asked about
  size_t joint;  // that leaves its limits, or NSVCD_NONE
  // the greatest logit of a query, its time and its pair
  float logit, time;
  size_t pair;
  int proven;  // that query was answered by proof, and did not find the pair free
} nsvcd__cost;

typedef struct nsvcd__planner {
  const nsvcd_plan_problem *in;  // the problem
  nsvcd_plan_options options;    // with the defaults filled in
  nsvcd__stage explore, refine, check;
  void *query;  // workspace of queries
  size_t query_size;
  uint64_t random;                      // the state of the random numbers
  float first_noise[NSVCD_MAX_JOINTS];  // deviations of the first rollouts
  nsvcd_result error;                   // of a query or a pose
  int cancelled;                        // by the progress callback
  nsvcd_plan_answer answer;             // what is counted so far
  nsvcd__cost cost;                     // of start or goal, then of `result`

  // the trajectory at hand
  float *path;             // (moments, F)
  nsvcd_pose *poses;       // (moments, B)
  nsvcd__stance *stances;  // (moments, B)
  nsvcd__shape *shapes;    // (B)
  unsigned char *meets;    // (moments): may the pair at hand meet there?
  uint32_t *queue;         // (P): pairs, in the order of queries
  float *wrenches;         // (moments, B, 6)
  nsvcd_pose *moved;       // (B): at a moment, with one joint moved
  float *jacobian;         // (B, 6, F)
  float *by_path;          // (F): derivative by the joints at a moment

  // control points, (M + 2, F) each
  float *result;    // the best of all seeds
  float *control;   // MPPI's mean, or L-BFGS's last point
  float *best;      // of this seed
  float *trial;     // whose cost is wanted
  float *gradient;  // there

  // via points, (M, F) each
  float *sum;      // mean of offsets, or of gradients
  float *offset;   // a change, or a direction
  float *drawn;    // (draws, M, F): the random changes
  float *costs;    // (draws): of rollouts, then their weights
  float *steps;    // (HISTORY, M, F): of L-BFGS
  float *changes;  // (HISTORY, M, F): of the gradient, by these steps
  double *vector;  // (M + 2): scratch
} nsvcd__planner;

static const nsvcd__cost nsvcd__no_cost = {
    0, 0, 0, 0, NSVCD_NONE, -NSVCD_LOGIT_CERTAIN, 0, NSVCD_NONE, 0};

static int nsvcd__is_free(const nsvcd__cost *cost) {
  return !cost->collides && cost->joint == NSVCD_NONE;
}

// ---- memory

static size_t nsvcd__larger(size_t a, size_t b) {
  return a > b ? a : b;
}

// A weight: the default for 0, and 0 for what is negative.
static float nsvcd__weight_of(float given, float otherwise) {
  return given > 0 ? given : given < 0 ? 0 : otherwise;
}

// A stage as the caller gave it, with the defaults for zeros. Returns 0 if it is out of range.
static int nsvcd__stage_of(const nsvcd_plan_stage *given, nsvcd_plan_stage otherwise,
                           nsvcd__stage *stage) {
  const size_t segments = given->segments ? given->segments : otherwise.segments;
  stage->via = given->via_points ? given->via_points : otherwise.via_points;
  stage->moments = segments + 1;
  stage->iterations = given->iterations ? given->iterations : otherwise.iterations;
  if (given->iterations == NSVCD_NONE) stage->iterations = 0;
  stage->draws = given->draws ? given->draws : otherwise.draws;
  stage->noise = nsvcd__weight_of(given->noise, otherwise.noise);
  return stage->via <= NSVCD_MAX_VIA_POINTS && segments <= NSVCD_MAX_PLAN_SEGMENTS &&
         stage->draws <= 10000 && stage->iterations <= 100000;
}

// Is the problem well formed?
static nsvcd_result nsvcd__problem_check(const nsvcd_plan_problem *in) {
  if (!in || !in->kinematics) return NSVCD_ERROR_ARGUMENT;
  if (in->joints < 1 || in->joints > NSVCD_MAX_JOINTS || in->body_count > 65536)
    return NSVCD_ERROR_COUNT;
  if (!in->low || !in->high || !in->start || !in->goal) return NSVCD_ERROR_ARGUMENT;
  const int by_network = !in->collision;
  if (in->pair_count > 0 && (!in->pairs || (by_network && !in->bodies)))
    return NSVCD_ERROR_ARGUMENT;
  // a body in no pair may be NULL
  for (size_t b = 0; in->bodies && b < in->body_count; b++) {
    const nsvcd_body *body = in->bodies[b];
    const nsvcd_result error = body ? nsvcd__body_check(body, SIZE_MAX) : NSVCD_OK;
    if (error) return error;
  }
  for (size_t k = 0; k < in->pair_count; k++) {
    const size_t a = in->pairs[k].a;
    const size_t b = in->pairs[k].b;
    if (a >= in->body_count || b >= in->body_count || a == b) return NSVCD_ERROR_PAIR;
    if (by_network && (!in->bodies[a] || !in->bodies[b])) return NSVCD_ERROR_ARGUMENT;
  }
  return NSVCD_OK;
}

// Checks problem and options; fills in the defaults.
static nsvcd_result nsvcd__planner_settings(const nsvcd_plan_problem *problem,
                                            const nsvcd_plan_options *options,
                                            nsvcd__planner *p) {
  // via points, segments, iterations, draws, noise
  static const nsvcd_plan_stage explore = {5, 24, 40, 100, 0.3f};
  static const nsvcd_plan_stage refine = {10, 22, 10, 10, 0.01f};
  nsvcd__settings unused;
  memset(p, 0, sizeof *p);
  nsvcd_result error = nsvcd__problem_check(problem);
  if (error) return error;
  p->in = problem;
  if (options) p->options = *options;
  nsvcd_plan_options *o = &p->options;
  const float floats[8] = {o->velocity, o->acceleration, o->jerk,          o->collision,
                           o->duration, o->margin,       o->explore.noise, o->refine.noise};
  if (!nsvcd__in_range(floats, 8, FLT_MAX)) return NSVCD_ERROR_PLAN;
  error = nsvcd__settings_of(&o->sweep.network, 1, 1, &unused);
  if (error) return error;
  if (!nsvcd__stage_of(&o->explore, explore, &p->explore) ||
      !nsvcd__stage_of(&o->refine, refine, &p->refine))
    return NSVCD_ERROR_STAGE;
  if (o->refine.iterations == NSVCD_NONE) p->refine.via = p->explore.via;

  o->seeds = o->seeds ? o->seeds : 6;
  o->velocity = nsvcd__weight_of(o->velocity, 10);
  o->acceleration = nsvcd__weight_of(o->acceleration, 2);
  o->jerk = nsvcd__weight_of(o->jerk, 10);
  // some form has to be positive definite
  if (!(o->velocity > 0 || o->acceleration > 0 || o->jerk > 0)) o->velocity = 1e-3f;
  o->collision = nsvcd__weight_of(o->collision, 20);
  o->duration = o->duration > 0 ? o->duration : 20;
  o->margin = nsvcd__weight_of(o->margin, 2);

  p->check = p->refine;
  const size_t finest = nsvcd__larger(p->explore.moments, p->refine.moments);
  const size_t most = 4 * NSVCD_MAX_PLAN_SEGMENTS;
  const size_t dense = NSVCD__CHECKS * (finest - 1);
  o->check = o->check ? o->check : dense < most ? dense : most;
  p->check.moments = o->check + 1;
  return o->check <= most && o->seeds <= 1000 ? NSVCD_OK : NSVCD_ERROR_PLAN;
}

// nsvcd__take, of rows of floats.
static float *nsvcd__take_floats(char *base, uint64_t *used, size_t rows, size_t floats) {
  return (float *)nsvcd__take(base, used, rows, floats * sizeof(float));
}

// Lays the planner's arrays out from `base` on, or, if that is NULL, only measures them. Returns
// the bytes; 0 if they exceed SIZE_MAX.
static size_t nsvcd__planner_memory(nsvcd__planner *p, char *base) {
  nsvcd__stage *const stages[3] = {&p->explore, &p->refine, &p->check};
  float **const points[7] = {&p->result,   &p->control, &p->best,  &p->trial,
                             &p->gradient, &p->sum,     &p->offset};
  const size_t f = p->in->joints;
  const size_t bodies = p->in->body_count;
  const size_t via = nsvcd__larger(p->explore.via, p->refine.via);
  const size_t draws = nsvcd__larger(p->explore.draws, p->refine.draws);
  const size_t finest = nsvcd__larger(p->explore.moments, p->refine.moments);
  const size_t moments = nsvcd__larger(p->check.moments, finest);
  const size_t poses = moments * bodies;
  const size_t point = (via + 2) * f;
  uint64_t used = 0;

  p->query_size = nsvcd_sweep_workspace_size(NULL);
  p->query = nsvcd__take(base, &used, 1, p->query_size);
  for (size_t k = 0; k < 3; k++) {
    nsvcd__stage *stage = stages[k];
    const size_t all = stage->via + 2;
    stage->numbers = stage->via * f;
    stage->bytes = all * f * sizeof(float);
    stage->form = (double *)nsvcd__take(base, &used, all, all * sizeof(double));
    stage->factor = NSVCD__TAKE_ROWS(double, stage->via * stage->via, base, &used);
    stage->weights = nsvcd__take_floats(base, &used, stage->moments, all);
  }

  p->path = nsvcd__take_floats(base, &used, moments, f);
  p->poses = NSVCD__TAKE_ROWS(nsvcd_pose, poses, base, &used);
  p->stances = NSVCD__TAKE_ROWS(nsvcd__stance, poses, base, &used);
  p->shapes = NSVCD__TAKE_ROWS(nsvcd__shape, bodies, base, &used);
  p->meets = NSVCD__TAKE_ROWS(unsigned char, moments, base, &used);
  p->queue = NSVCD__TAKE_ROWS(uint32_t, p->in->pair_count, base, &used);
  p->wrenches = nsvcd__take_floats(base, &used, poses, 6);
  p->moved = NSVCD__TAKE_ROWS(nsvcd_pose, bodies, base, &used);
  p->jacobian = nsvcd__take_floats(base, &used, bodies, 6 * f);
  p->by_path = nsvcd__take_floats(base, &used, 1, f);

  for (size_t k = 0; k < 7; k++) *points[k] = nsvcd__take_floats(base, &used, 1, point);
  p->drawn = nsvcd__take_floats(base, &used, draws, point);
  p->costs = nsvcd__take_floats(base, &used, 1, draws);
  p->steps = nsvcd__take_floats(base, &used, NSVCD__HISTORY, point);
  p->changes = nsvcd__take_floats(base, &used, NSVCD__HISTORY, point);
  p->vector = NSVCD__TAKE_ROWS(double, via + 2, base, &used);
  return used <= SIZE_MAX ? (size_t)used : 0;
}

// Fills in what a stage computes once.
static void nsvcd__stage_init(const nsvcd_plan_options *o, nsvcd__stage *stage) {
  const double weights[3] = {(double)o->velocity, (double)o->acceleration, (double)o->jerk};
  const size_t via = stage->via;
  const size_t all = via + 2;
  double w[NSVCD_MAX_VIA_POINTS + 2];
  double rate = 1;
  for (size_t k = 0; k < all * all; k++) stage->form[k] = 0;
  for (size_t d = 1; d <= 3; d++) {
    rate /= (double)o->duration * (double)o->duration;
    nsvcd__add_mean_square(via, d, rate * weights[d - 1], stage->form);
  }
  for (size_t k = 0; k < via * via; k++)
    stage->factor[k] = stage->form[(k / via + 1) * all + k % via + 1];
  nsvcd__cholesky(stage->factor, via);

  // the variance of via point k is |L^-1 e_k|^2
  stage->deviation = 0;
  for (size_t k = 0; k < via; k++) {
    double square = 0;
    for (size_t i = 0; i < via; i++) w[i] = i == k;
    nsvcd__solve_lower(stage->factor, via, w);
    for (size_t i = 0; i < via; i++) square += w[i] * w[i];
    stage->deviation = fmax(sqrt(square), stage->deviation);
  }

  const size_t last = stage->moments - 1;
  for (size_t s = 0; s <= last; s++) {
    nsvcd__spline_weights(via, last > 0 ? (double)s / (double)last : 0, 0, w);
    for (size_t k = 0; k < all; k++) stage->weights[s * all + k] = (float)w[k];
  }
}
#endif  // NSVCD_NO_OPTIMIZER
