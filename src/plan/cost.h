// In: control points. Out: what they cost, smoothness + limits + collision, and its derivative by
// them.
#pragma once
#include "culling.h"

#ifndef NSVCD_NO_OPTIMIZER
// From the wrenches (B, 6) at a moment to the derivative by its joints, p->by_path (F), by
// differences of `kinematics`. poses: (B), at these joints.
static void nsvcd__by_differences(nsvcd__planner *p, const float *joints,
                                  const nsvcd_pose *poses, const float *wrenches) {
  float moved[NSVCD_MAX_JOINTS];
  memcpy(moved, joints, p->in->joints * sizeof *moved);
  for (size_t j = 0; j < p->in->joints; j++) {
    moved[j] = joints[j] + (NSVCD__JOINT_STEP + NSVCD__JOINT_STEP_FRACTION * fabsf(joints[j]));
    const float step = moved[j] - joints[j];  // as rounded
    p->in->kinematics(p->in->user, moved, p->moved);
    moved[j] = joints[j];
    p->by_path[j] = 0;
    for (size_t b = 0; b < p->in->body_count; b++) {
      const nsvcd__quat q = nsvcd__quat_load(poses[b].rotation);
      const nsvcd__quat r = nsvcd__quat_load(p->moved[b].rotation);
      const float twice = nsvcd__quat_dot(q, r) < 0 ? -2.0f : 2.0f;
      const nsvcd__f3 turn = nsvcd__f3_scale(nsvcd__quat_turn(q, r), twice / step);
      const nsvcd__f3 from = nsvcd__f3_load(poses[b].position);
      const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__f3_load(p->moved[b].position), from);
      p->by_path[j] += nsvcd__f3_dot(nsvcd__f3_row(wrenches, 2 * b), offset) / step;
      p->by_path[j] += nsvcd__f3_dot(nsvcd__f3_row(wrenches, 2 * b + 1), turn);
    }
  }
}

// The poses (moments, B) at joints (moments, F), with quaternions of unit length.
static void nsvcd__find_poses(nsvcd__planner *p, const float *joints, size_t moments,
                              nsvcd_pose *poses) {
  const size_t bodies = p->in->body_count;
  const size_t count = moments * bodies;
  for (size_t s = 0; s < moments; s++)
    p->in->kinematics(p->in->user, joints + s * p->in->joints, poses + s * bodies);
  const nsvcd_result error = count > 0 ? nsvcd__poses_check(poses, count) : NSVCD_OK;
  if (error) p->error = error;
  for (size_t k = 0; k < count && !error; k++) {
    const nsvcd__quat unit = nsvcd__quat_unit(nsvcd__quat_load(poses[k].rotation));
    nsvcd__quat_store(unit, poses[k].rotation);
  }
}

// The smoothness of a trajectory; gradient: (M + 2, F), written, or NULL.
static float nsvcd__smoothness(const nsvcd__planner *p, const nsvcd__stage *stage,
                               const float *control, float *gradient) {
  const size_t f = p->in->joints;
  const size_t all = stage->via + 2;
  double smoothness = 0;
  for (size_t j = 0; j < f; j++) {
    for (size_t i = 0; i < all; i++) {
      double sum = 0;
      for (size_t k = 0; k < all; k++)
        sum += stage->form[i * all + k] * (double)control[k * f + j];
      smoothness += sum * (double)control[i * f + j];
      if (gradient) gradient[i * f + j] = (float)(2 * sum);
    }
  }
  return (float)smoothness;
}

static int nsvcd__leaves_limits(const nsvcd_plan_problem *problem, size_t joint, float value) {
  const float rounding = 1e-5f + 1e-6f * fabsf(value);
  return value < problem->low[joint] - rounding || value > problem->high[joint] + rounding;
}

// Fills p->path with the joints at the moments. Adds the cost of those beyond their limits, or
// within the margin before these. gradient: (M + 2, F), added to, or NULL.
static void nsvcd__add_limits(nsvcd__planner *p, const nsvcd__stage *stage,
                              const float *control, float *gradient, nsvcd__cost *cost) {
  const size_t f = p->in->joints;
  const size_t all = stage->via + 2;
  const float fraction = NSVCD__LIMIT_COST / (float)stage->moments;
  // via points too: moments may be too few to hit one
  for (size_t k = f; k < f + stage->numbers && cost->joint == NSVCD_NONE; k++) {
    if (nsvcd__leaves_limits(p->in, k % f, control[k])) cost->joint = k % f;
  }
  for (size_t s = 0; s < stage->moments; s++) {
    const float *w = stage->weights + s * all;
    for (size_t j = 0; j < f; j++) {
      float value = 0;
      for (size_t k = 0; k < all; k++) value += w[k] * control[k * f + j];
      p->path[s * f + j] = value;

      const float low = p->in->low[j];
      const float high = p->in->high[j];
      const float inner = NSVCD__LIMIT_MARGIN * (high - low);
      float out = value > high - inner ? value - high + inner : 0;
      if (value < low + inner) out = value - low - inner;
      cost->total += fraction * out * out;
      if (nsvcd__leaves_limits(p->in, j, value)) cost->joint = j;
      for (size_t k = 0; gradient && k < all; k++)
        gradient[k * f + j] += 2 * fraction * out * w[k];
    }
  }
}

// Adds the derivative of the cost of collision, from p->wrenches, to the gradient (M + 2, F).
static void nsvcd__add_collision_gradient(nsvcd__planner *p, const nsvcd__stage *stage,
                                          float *gradient) {
  const size_t f = p->in->joints;
  const size_t numbers = 6 * p->in->body_count;
  const size_t all = stage->via + 2;
  for (size_t s = 0; s < stage->moments; s++) {
    const float *joints = p->path + s * f;
    const float *wrenches = p->wrenches + s * numbers;
    int has_any = 0;
    for (size_t k = 0; k < numbers && !has_any; k++)
      has_any = wrenches[k] < 0 || wrenches[k] > 0;
    if (!has_any) continue;
    if (p->in->jacobian) {
      p->in->jacobian(p->in->user, joints, p->jacobian);
      for (size_t j = 0; j < f; j++) {
        p->by_path[j] = 0;
        for (size_t i = 0; i < numbers; i++)
          p->by_path[j] += wrenches[i] * p->jacobian[i * f + j];
      }
    } else {
      nsvcd__by_differences(p, joints, p->poses + s * p->in->body_count, wrenches);
    }
    for (size_t k = 0; k < all; k++) {
      const float weight = p->options.collision * stage->weights[s * all + k];
      for (size_t j = 0; j < f; j++) gradient[k * f + j] += weight * p->by_path[j];
    }
  }
}

// The cost of a trajectory; the sum may stop beyond `limit`. gradient: (M + 2, F), written, or
// NULL.
static nsvcd__cost nsvcd__cost_of(nsvcd__planner *p, const nsvcd__stage *stage,
                                  const float *control, float limit, float *gradient) {
  const size_t numbers = 6 * stage->moments * p->in->body_count;
  const float weight = p->options.collision;
  const int at_end = stage == &p->check;
  float *wrenches = gradient ? p->wrenches : NULL;
  nsvcd__cost cost = nsvcd__no_cost;
  p->answer.trajectories++;
  cost.smoothness = nsvcd__smoothness(p, stage, control, gradient);
  cost.total = cost.smoothness;
  nsvcd__add_limits(p, stage, control, gradient, &cost);
  if (cost.total > limit || p->error) return cost;
  nsvcd__find_poses(p, p->path, stage->moments, p->poses);
  if (p->error) return cost;

  const float left = weight > 0 ? (limit - cost.total) / weight : INFINITY;
  if (wrenches) memset(wrenches, 0, numbers * sizeof *wrenches);
  nsvcd__add_collision(p, stage->moments, left, wrenches, at_end, &cost);
  cost.total += weight * cost.collision;
  if (gradient) nsvcd__add_collision_gradient(p, stage, gradient);
  if (!nsvcd__is_finite(cost.total)) p->error = NSVCD_ERROR_NUMBER;
  return cost;
}
#endif  // NSVCD_NO_OPTIMIZER
