// In: a planning problem. Out: control points of a motion that hits nothing, by the last check, or
// of the best that was found.
#pragma once
#include "refine.h"

#ifndef NSVCD_NO_OPTIMIZER
// The smoothest control points from start to goal, (M + 2, F): where the form's derivative is zero.
static void nsvcd__smoothest(nsvcd__planner *p, const nsvcd__stage *stage, float *control) {
  const size_t f = p->in->joints;
  const size_t via = stage->via;
  const size_t all = via + 2;
  for (size_t j = 0; j < f; j++) {
    const double start = (double)p->in->start[j];
    const double goal = (double)p->in->goal[j];
    for (size_t k = 0; k < via; k++) {
      const double *row = stage->form + (k + 1) * all;
      p->vector[k] = -row[0] * start - row[all - 1] * goal;
    }
    nsvcd__solve_lower(stage->factor, via, p->vector);
    nsvcd__solve_upper(stage->factor, via, p->vector);
    for (size_t k = 0; k < via; k++) control[(k + 1) * f + j] = (float)p->vector[k];
  }
  memcpy(control, p->in->start, f * sizeof *control);
  memcpy(control + (via + 1) * f, p->in->goal, f * sizeof *control);
}

// Are the joints within the limits, and free of collision? Leaves what is wrong in p->cost.
static int nsvcd__is_good(nsvcd__planner *p, const float *joints) {
  nsvcd__cost *cost = &p->cost;
  *cost = nsvcd__no_cost;
  for (size_t j = 0; j < p->in->joints; j++) {
    if (joints[j] < p->in->low[j] || joints[j] > p->in->high[j]) cost->joint = j;
  }
  if (cost->joint != NSVCD_NONE) {
    cost->logit = 0;
    return 0;
  }
  nsvcd__find_poses(p, joints, 1, p->poses);
  if (p->error) return 0;
  nsvcd__add_collision(p, 1, INFINITY, NULL, 1, cost);
  return !cost->collides;
}

NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options) {
  nsvcd__planner planner;
  if (nsvcd__planner_settings(problem, options, &planner)) return 0;
  return nsvcd__planner_memory(&planner, NULL);
}

// Fills in what is computed once, when the memory is laid out.
static void nsvcd__planner_begin(nsvcd__planner *p) {
  nsvcd__stage_init(&p->options, &p->explore);
  nsvcd__stage_init(&p->options, &p->refine);
  nsvcd__stage_init(&p->options, &p->check);
  nsvcd__find_shapes(p);
  for (size_t k = 0; k < p->in->pair_count; k++) p->queue[k] = (uint32_t)k;
  for (size_t j = 0; j < p->in->joints; j++) {
    const float quarter = 0.25f * (p->in->high[j] - p->in->low[j]);
    p->first_noise[j] = p->explore.noise < quarter ? p->explore.noise : quarter;
  }
  p->random = p->options.seed;
}

// How far, at most, a point of a's bounding sphere is from where the last check has it, as b sees
// it. The check's motion is at a share `fraction` of the way from the poses `from` (B) to the next
// ones; the spline has its poses in p->moved.
static float nsvcd__pair_deviation(const nsvcd__planner *p, const nsvcd_body_pair *pair,
                                   const nsvcd_pose *from, double fraction) {
  const nsvcd_pose *to = from + p->in->body_count;
  const nsvcd__sphere *sphere = &p->shapes[pair->a].sphere;
  const nsvcd_pose start = nsvcd__relative_pose(&from[pair->a], &from[pair->b]);
  const nsvcd_pose end = nsvcd__relative_pose(&to[pair->a], &to[pair->b]);
  const nsvcd_pose spline = nsvcd__relative_pose(&p->moved[pair->a], &p->moved[pair->b]);
  const nsvcd__d3 pivot = nsvcd__d3_of(0, 0, 0);
  const nsvcd__world_pose check = nsvcd__world_pose_between(&start, &end, pivot, fraction);
  const nsvcd__quat q = nsvcd__quat_load(spline.rotation);
  const nsvcd__transform at = {nsvcd__mat3_of(q), nsvcd__f3_load(spline.position)};
  const nsvcd__transform checked = {nsvcd__mat3_of(check.rotation),
                                    nsvcd__d3_narrow(check.position)};
  const nsvcd__f3 x = nsvcd__f3_transform(&at, sphere->centre);
  const nsvcd__f3 y = nsvcd__f3_transform(&checked, sphere->centre);
  const float shift = nsvcd__f3_norm(nsvcd__f3_sub(x, y));
  return shift + 2 * nsvcd__f3_norm(nsvcd__quat_turn(check.rotation, q)) * sphere->radius;
}

// How far the spline deviates from the last check's motion between p->poses: the most of all pairs
// whose a is given. Measured, not bounded: nothing is known of `kinematics` but its values. A
// smooth curve deviates most half way between two poses, and is sampled there, in every stride-th
// segment. If segments are few, each is sampled more often, for an S crosses its chord half way.
static float nsvcd__plan_deviation(nsvcd__planner *p, const float *control) {
  const size_t segments = p->check.moments - 1;
  const size_t wanted = NSVCD__DEVIATION_SAMPLES * (p->check.via + 1);
  const size_t stride = wanted < segments ? segments / wanted : 1;
  const size_t samples = 2 * (wanted / segments) + 1;  // of a segment
  float joints[NSVCD_MAX_JOINTS];
  float most = 0;
  for (size_t n = 0; p->in->bodies && n / samples * stride < segments; n++) {
    const size_t s = n / samples * stride;
    const double fraction = (double)(n % samples + 1) / (double)(samples + 1);
    const double t = ((double)s + fraction) / (double)segments;
    nsvcd_spline(control, p->check.via, p->in->joints, (float)t, 0, joints);
    nsvcd__find_poses(p, joints, 1, p->moved);
    if (p->error) break;
    for (size_t k = 0; k < p->in->pair_count; k++) {
      const nsvcd_body_pair *pair = &p->in->pairs[k];
      const nsvcd_pose *from = p->poses + s * p->in->body_count;
      if (p->in->bodies[pair->a])
        most = fmaxf(nsvcd__pair_deviation(p, pair, from, fraction), most);
    }
  }
  return most;
}

// Searches from one more start. Keeps what it finds in p->result if that is the best so far.
// Returns whether to try another.
static int nsvcd__try_seed(nsvcd__planner *p) {
  const size_t f = p->in->joints;
  const float margin = p->options.margin;
  nsvcd_plan_answer *answer = &p->answer;
  nsvcd__cost cost = nsvcd__no_cost;
  // from the smoothest trajectory, then from random changes of it
  nsvcd__smoothest(p, &p->explore, p->control);
  if (answer->seeds > 0) {
    nsvcd__smooth_noise(p, &p->explore, p->first_noise, p->offset);
    nsvcd__change(p, &p->explore, p->control, p->offset, 1, p->trial);
    memcpy(p->control, p->trial, p->explore.bytes);
  }
  nsvcd__explore(p);

  // Nearly the same curve through another number of via points; these are clamped to the limits,
  // which a curve may leave between two points.
  if (p->explore.via != p->refine.via) {
    for (size_t k = 0; k < p->refine.via + 2; k++) {
      const float t = (float)k / (float)(p->refine.via + 1);
      nsvcd_spline(p->best, p->explore.via, f, t, 0, p->trial + k * f);
    }
    nsvcd__change(p, &p->refine, p->trial, p->trial, 0, p->best);
  }

  // until the last check finds it free, with a wider margin after each hit that is proven
  for (size_t retry = 0; retry <= NSVCD__RETRIES; retry++) {
    nsvcd__refine(p);
    cost = nsvcd__cost_of(p, &p->check, p->best, INFINITY, NULL);
    if (nsvcd__is_free(&cost) || p->cancelled || p->error || !cost.proven) break;
    p->options.margin = 2 * p->options.margin + 0.5f;
  }
  p->options.margin = margin;
  const int good = nsvcd__is_free(&cost);
  if (answer->seeds == 0 || good || cost.total < p->cost.total) {
    memcpy(p->result, p->best, p->refine.bytes);
    p->cost = cost;
    answer->deviation = nsvcd__plan_deviation(p, p->result);
  }
  answer->seeds++;
  answer->status = NSVCD_PLAN_LIMIT;
  if (good) answer->status = NSVCD_PLAN_CONVERGED;
  if (p->cancelled) answer->status = NSVCD_PLAN_CANCELLED;
  return !good && !p->cancelled && !p->error && answer->seeds < p->options.seeds;
}

NSVCDDEF nsvcd_result nsvcd_plan(const nsvcd_plan_problem *problem,
                                 const nsvcd_plan_options *options, void *workspace,
                                 size_t workspace_size, float *control,
                                 nsvcd_plan_answer *answer) {
  nsvcd__planner p;
  const nsvcd_result error = nsvcd__planner_settings(problem, options, &p);
  if (error) return error;
  if (!control || !answer) return NSVCD_ERROR_ARGUMENT;
  const size_t needed = nsvcd__planner_memory(&p, NULL);
  if (needed == 0) return NSVCD_ERROR_TOO_LARGE;
  if (!workspace || !nsvcd__is_aligned(workspace) || workspace_size < needed)
    return NSVCD_ERROR_WORKSPACE;
  for (size_t j = 0; j < problem->joints; j++) {
    const float ends[4] = {problem->low[j], problem->high[j], problem->start[j],
                           problem->goal[j]};
    if (!nsvcd__in_range(ends, 4, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_VALUE;
    if (ends[0] > ends[1]) return NSVCD_ERROR_LIMITS;
  }

  (void)nsvcd__planner_memory(&p, (char *)workspace);
  nsvcd__planner_begin(&p);
  nsvcd_plan_answer *out = &p.answer;
  if (!nsvcd__is_good(&p, problem->start)) {
    out->status = NSVCD_PLAN_START;
  } else if (!nsvcd__is_good(&p, problem->goal)) {
    out->status = NSVCD_PLAN_GOAL;
    p.cost.time = 1;
  }
  nsvcd__smoothest(&p, &p.refine, p.best);
  int more = out->status == NSVCD_PLAN_CONVERGED && !p.error;
  while (more) more = nsvcd__try_seed(&p);
  if (p.error) return p.error;

  memcpy(control, out->seeds ? p.result : p.best, p.refine.bytes);
  out->via_points = p.refine.via;
  out->cost = p.cost.total;
  out->smoothness = p.cost.smoothness;
  out->collides = p.cost.collides;
  out->joint = p.cost.joint;
  out->logit = p.cost.logit;
  out->time = p.cost.time;
  out->pair = p.cost.pair;
  *answer = *out;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_OPTIMIZER
