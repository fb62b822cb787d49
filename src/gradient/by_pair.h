// In: the tape of the pair that decided an answer. Out: the derivative of its logit by the poses.
// Reverse mode, step by step from the end, over one pair. `by_x` is the derivative of the logit by
// x:
//
//   decoder     by the decoder's inputs: network/tape, for its weights are many. All else is in
//               scalars
//   pair        by the line between the centres, the velocity, and the rotations, through the frame
//               and the facts
//   instants    by the moving body's poses at t_enter, t_exit and in the middle, and by these times
//   contact     from the times to the poses at the ends of the segment in which the balls meet or
//               separate
//   poses       from the pose at any time to the caller's poses
//
// The derivative by the pose of a rigid body is a wrench: a force (by a displacement of its origin)
// and a torque (by a small rotation about that). A force f on a point at `arm` from the origin is
// the force f and the torque arm x f.
#pragma once
#include "../body/body.h"
#include "../network/latent_rotation.h"
#include "../task/facts.h"

#ifndef NSVCD_NO_GRADIENT
// The derivative of |a| by a, times `by`. Where |a| is 0 to rounding it is 0, the mean of all
// directions.
static nsvcd__f3 nsvcd__by_length(nsvcd__f3 a, float by) {
  const float length = nsvcd__f3_norm(a);
  return nsvcd__f3_scale(a, length > 1e-6f ? by / length : 0);
}

// *sum += s a
static NSVCD__NOINLINE void nsvcd__add_to(nsvcd__f3 *sum, float s, nsvcd__f3 a) {
  *sum = nsvcd__f3_fma(s, a, *sum);
}

// a without its part along the unit vector n.
static nsvcd__f3 nsvcd__f3_across(nsvcd__f3 a, nsvcd__f3 n) {
  return nsvcd__f3_fma(-nsvcd__f3_dot(a, n), n, a);
}

// a's part along the unit vector n (or 0), times `along`, plus the rest, turned about n by `angle`,
// times `across`. Every linear map that commutes with rotations about n is of this form.
static nsvcd__f3 nsvcd__turned(nsvcd__f3 a, nsvcd__f3 n, float along, float across,
                               float angle) {
  const float c = across * cosf(angle);
  const float rest = (along - c) * nsvcd__f3_dot(n, a);
  const nsvcd__f3 side = nsvcd__f3_scale(n, across * sinf(angle));
  const nsvcd__f3 sum = nsvcd__f3_fma(rest, n, nsvcd__f3_scale(a, c));
  return nsvcd__f3_add(sum, nsvcd__f3_cross(side, a));
}

// The derivative by a small rotation of a latent, from its vectors x and the derivative by these,
// both (3, CHANNELS), then (5, CHANNELS). On degree 2, in the basis of nsvcd__degree2, a rotation
// by w adds to q
//   (wy q1 - wx q3 + 2 wz q4, wz q3 - wy q0 - wx (r q2 + q4), r (wx q1 - wy q3),
//    wx q0 - wz q1 + wy (r q2 - q4), wx q1 + wy q3 - 2 wz q0), where r is the root of 3.
static nsvcd__f3 nsvcd__latent_torque(const float *x, const float *by) {
  const float r = 1.7320508075688772f;
  nsvcd__f3 torque = {0, 0, 0};
  for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
    float both[2][8];
    for (size_t k = 0; k < 8; k++) {
      both[0][k] = x[NSVCD_W_CHANNELS * k + c];
      both[1][k] = by[NSVCD_W_CHANNELS * k + c];
    }
    const float *q = both[0] + 3;
    const float *h = both[1] + 3;
    const nsvcd__f3 vector = nsvcd__f3_load(q - 3);
    const nsvcd__f3 degree1 = nsvcd__f3_cross(vector, nsvcd__f3_load(h - 3));
    nsvcd__f3 degree2;
    degree2.x = h[3] * q[0] - h[0] * q[3] + r * (h[2] * q[1] - h[1] * q[2]);
    degree2.y = h[0] * q[1] - h[1] * q[0] + r * (h[3] * q[2] - h[2] * q[3]);
    degree2.z = h[1] * q[3] - h[3] * q[1] + 2 * (h[0] * q[4] - h[4] * q[0]);
    degree2.x = degree2.x + h[4] * q[1] - h[1] * q[4];
    degree2.y = degree2.y + h[4] * q[3] - h[3] * q[4];
    torque = nsvcd__f3_add(nsvcd__f3_add(torque, degree1), degree2);
  }
  return torque;
}

// The derivative of a logit by a pair, in the fixed body's axes and units.
typedef struct nsvcd__by_pair {
  nsvcd__f3 p1, v, w;
  nsvcd__f3 rotation;  // by a small rotation of the moving patch about its centre
} nsvcd__by_pair;

// The derivative of a logit by what the frame sees, by axis 1, and the torque on all of that, in
// the frame.
typedef struct nsvcd__by_view {
  nsvcd__f3 d, v, w, lean, axis1, torque;
} nsvcd__by_view;

// *sum += m's transpose times a
static void nsvcd__add_transpose(nsvcd__f3 *sum, const nsvcd__mat3 *m, nsvcd__f3 a) {
  nsvcd__add_to(sum, a.x, m->x);
  nsvcd__add_to(sum, a.y, m->y);
  nsvcd__add_to(sum, a.z, m->z);
}

// The adjoint of the facts: by (FACTS), added to `out`.
static void nsvcd__by_facts(const nsvcd__view *view, const float *facts, const float *by,
                            nsvcd__by_view *out) {
  const float tau = facts[NSVCD__FACT_TAU];
  const float scale = 1 / (nsvcd__f3_dot(view->v, view->v) + 1e-6f);
  const nsvcd__f3 closest = nsvcd__f3_sub(view->d, nsvcd__f3_scale(view->v, tau));
  const nsvcd__f3 by_distance = nsvcd__by_length(view->d, by[NSVCD__FACT_DISTANCE]);
  const nsvcd__f3 by_closest = nsvcd__by_length(closest, by[NSVCD__FACT_CLOSEST]);
  nsvcd__add_to(&out->d, 1, by_distance);
  nsvcd__add_to(&out->d, 1, by_closest);
  nsvcd__add_to(&out->v, -tau, by_closest);
  // where tau is not clamped
  if (fabsf(tau) < 1) {
    const float direct = by[NSVCD__FACT_TAU];
    const float by_tau = scale * (direct - nsvcd__f3_dot(by_closest, view->v));
    nsvcd__add_to(&out->d, by_tau, view->v);
    nsvcd__add_to(&out->v, by_tau, view->d);
    nsvcd__add_to(&out->v, -2 * by_tau * tau, view->v);
  }

  const nsvcd__f3 velocity = nsvcd__f3_load(facts + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 turn = nsvcd__f3_load(facts + NSVCD__FACT_TURN);
  const nsvcd__f3 by_velocity = nsvcd__f3_load(by + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 by_turn = nsvcd__f3_load(by + NSVCD__FACT_TURN);
  const nsvcd__f3 mirrored = nsvcd__f3_scale(by_turn, view->side);
  nsvcd__add_transpose(&out->v, &view->frame, by_velocity);
  nsvcd__add_transpose(&out->w, &view->frame, mirrored);
  nsvcd__add_to(&out->torque, 1, nsvcd__f3_cross(velocity, by_velocity));
  nsvcd__add_to(&out->torque, 1, nsvcd__f3_cross(turn, by_turn));
  nsvcd__add_to(&out->v, 1, nsvcd__by_length(view->v, by[NSVCD__FACT_SPEED]));
  nsvcd__add_to(&out->w, 1, nsvcd__by_length(view->w, by[NSVCD__FACT_SPIN]));
}

// The adjoint of the frame in nsvcd__views_of, added to `by`. Its conventions are taken as
// constant, and turning it does the opposite of turning all that it sees.
static void nsvcd__by_frame(const nsvcd__view *view, nsvcd__by_view *by) {
  const nsvcd__f3 e1 = view->frame.x;
  const nsvcd__f3 e2 = view->frame.y;
  const nsvcd__f3 e3 = view->frame.z;
  const float length = nsvcd__f3_norm(view->d);
  const nsvcd__f3 line = nsvcd__f3_of(view->lean.x + 1e-6f, view->lean.y, view->lean.z);

  // Axis 2: the direction of a reference a, without its part along axis 1.
  nsvcd__f3 a = nsvcd__f3_add(nsvcd__f3_scale(view->lean, NSVCD__LEAN), view->v);
  nsvcd__f3 across = nsvcd__f3_across(a, e1);
  const int vanishes = nsvcd__f3_norm(across) <= 1e-7f;
  if (vanishes) {
    // the coordinate axis farthest from e1
    const float x = fabsf(e1.x);
    const float y = fabsf(e1.y);
    const float z = fabsf(e1.z);
    a = y <= z ? nsvcd__f3_of(0, 1, 0) : nsvcd__f3_of(0, 0, 1);
    if (x <= y && x <= z) a = nsvcd__f3_of(1, 0, 0);
    across = nsvcd__f3_across(a, e1);
  }
  const float about = by->torque.x / nsvcd__f3_norm(across);
  if (!vanishes) {
    nsvcd__add_to(&by->v, -about, e3);
    nsvcd__add_to(&by->lean, -about * NSVCD__LEAN, e3);
  }

  // Axis 1: the direction of the line, or of what replaces it.
  nsvcd__f3 by_e1 = nsvcd__f3_across(by->axis1, e1);
  nsvcd__add_to(&by_e1, by->torque.y + about * nsvcd__f3_dot(e1, a), e3);
  nsvcd__add_to(&by_e1, -by->torque.z, e2);
  if (length > 1e-5f)
    nsvcd__add_to(&by->d, 1 / length, by_e1);
  else if (nsvcd__f3_norm(line) > 1e-9f)
    nsvcd__add_to(&by->lean, 1 / nsvcd__f3_norm(line), by_e1);
}

// ---- gaps

// As nsvcd__turned_back, by tau w. With -tau it is the adjoint by u.
static nsvcd__f3 nsvcd__f3_turned_back(nsvcd__f3 u, nsvcd__f3 w, float tau) {
  const nsvcd__f3 turned = nsvcd__f3_fma(tau, nsvcd__f3_cross(u, w), u);
  const float along = 0.5f * tau * tau * nsvcd__f3_dot(u, w);
  const float less = -0.5f * tau * tau * nsvcd__f3_dot(w, w);
  return nsvcd__f3_fma(less, u, nsvcd__f3_fma(along, w, turned));
}

// The derivative of nsvcd__turned_back(u, w, tau) . q by w.
static nsvcd__f3 nsvcd__turned_back_by_w(nsvcd__f3 u, nsvcd__f3 w, float tau, nsvcd__f3 q) {
  const float half = 0.5f * tau * tau;
  nsvcd__f3 out = nsvcd__f3_scale(nsvcd__f3_cross(q, u), tau);
  nsvcd__add_to(&out, half * nsvcd__f3_dot(w, q), u);
  nsvcd__add_to(&out, half * nsvcd__f3_dot(u, w), q);
  return nsvcd__f3_fma(-2 * half * nsvcd__f3_dot(u, q), w, out);
}

// The extreme point of a patch that is farthest along u, in 1/127 of the radius.
static nsvcd__f3 nsvcd__farthest_extreme(const int8_t *extremes, nsvcd__f3 u) {
  nsvcd__f3 best = {0, 0, 0};
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__GROUP) {
    const nsvcd__f3 extreme =
        nsvcd__f3_of(extremes[0], extremes[NSVCD__GROUP], extremes[2 * NSVCD__GROUP]);
    if (k == 0 || nsvcd__f3_dot(extreme, u) > nsvcd__f3_dot(best, u)) best = extreme;
  }
  return best;
}

// The adjoint of a gap along u at tau, times `by`, added to `out`; returns that by u. extremes: of
// the moving patch and of the fixed one. moves: 0 at rest, else 1.
static NSVCD__NOINLINE nsvcd__f3 nsvcd__by_gap(const nsvcd__pair *pair,
                                               const int8_t *const *extremes, nsvcd__f3 u,
                                               float tau, float moves, float by,
                                               nsvcd__by_pair *out) {
  const float half = 0.5f * tau;
  const nsvcd__f3 w = pair->w;
  const nsvcd__f3 back = nsvcd__f3_turned_back(u, w, half);
  const nsvcd__f3 forth = nsvcd__f3_turned_back(u, w, -half);
  const nsvcd__f3 own = nsvcd__mat3_apply_transpose(&pair->rotation, back);
  const nsvcd__f3 lowest = nsvcd__farthest_extreme(extremes[0], nsvcd__f3_scale(own, -1));
  const nsvcd__f3 highest = nsvcd__farthest_extreme(extremes[1], forth);
  const nsvcd__f3 turned = nsvcd__mat3_apply(&pair->rotation, lowest);
  const nsvcd__f3 q = nsvcd__f3_scale(turned, pair->r1 / 127);
  const nsvcd__f3 x = nsvcd__f3_scale(highest, pair->r2 / 127);
  const nsvcd__f3 on_q = nsvcd__turned_back_by_w(u, w, half, q);
  const nsvcd__f3 on_x = nsvcd__turned_back_by_w(u, w, -half, x);
  nsvcd__add_to(&out->p1, by, u);
  nsvcd__add_to(&out->v, moves * tau * by, u);
  nsvcd__add_to(&out->w, moves * by, nsvcd__f3_sub(on_q, on_x));
  nsvcd__add_to(&out->rotation, by, nsvcd__f3_cross(q, back));
  nsvcd__f3 by_u = nsvcd__f3_fma(tau, pair->v, nsvcd__f3_sub(pair->p1, pair->p2));
  nsvcd__add_to(&by_u, 1, nsvcd__f3_turned_back(q, w, -half));
  nsvcd__add_to(&by_u, -1, nsvcd__f3_turned_back(x, w, half));
  return nsvcd__f3_scale(by_u, by);
}

// The adjoint of nsvcd__gap_fact. size: the gap's absolute value.
static float nsvcd__by_gap_fact(float by, float size, float steep) {
  return by * steep / ((1 + steep * size) * (1 + steep * size));
}

// The adjoint of nsvcd__gap_axes_of: from the derivatives by the axes u (GAPS) to those by the line
// between the centres, added to `out`, and by the moving patch's normal, which is returned.
static nsvcd__f3 nsvcd__by_gap_axes(const nsvcd__pair *pair, const nsvcd__view *view,
                                    const nsvcd__f3 *u, const nsvcd__f3 *by_u,
                                    nsvcd__by_pair *out) {
  const nsvcd__f3 line = u[NSVCD__GAP_LINE];
  const int has_fixed = nsvcd__f3_norm(pair->normal[1]) > 0.5f;
  const int has_moving = nsvcd__f3_norm(view->normal) > 0.5f;
  const size_t of_moving = view->swap > 0 ? NSVCD__GAP_LARGER : NSVCD__GAP_SMALLER;
  const size_t of_fixed = view->swap > 0 ? NSVCD__GAP_SMALLER : NSVCD__GAP_LARGER;
  const nsvcd__f3 from = has_fixed ? pair->normal[1] : line;
  const nsvcd__f3 to = has_moving ? nsvcd__f3_scale(view->normal, -1) : line;
  const float length = nsvcd__f3_norm(nsvcd__f3_add(from, to));
  // An axis is the direction of a constant, plus multiples of the moving patch's normal, reversed,
  // and of the line.
  float normals[NSVCD__GAPS] = {0};
  float lines[NSVCD__GAPS] = {0};
  normals[of_moving] = has_moving ? 1 : 0;
  lines[of_moving] = has_moving ? 0 : 1;
  lines[of_fixed] = has_fixed ? 0 : 1;
  lines[NSVCD__GAP_LINE] = 1;
  lines[NSVCD__GAP_BOTH] = 1;
  if (length > 1e-3f) {
    normals[NSVCD__GAP_BOTH] = normals[of_moving] / length;
    lines[NSVCD__GAP_BOTH] = (lines[of_fixed] + lines[of_moving]) / length;
  }
  nsvcd__f3 by_normal = {0, 0, 0};
  nsvcd__f3 by_line = {0, 0, 0};
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__f3 across = nsvcd__f3_across(by_u[d], u[d]);
    nsvcd__add_to(&by_normal, -normals[d], across);
    nsvcd__add_to(&by_line, lines[d], across);
  }
  const float distance = nsvcd__f3_norm(nsvcd__f3_sub(pair->p1, pair->p2));
  const float inverse = 1 / fmaxf(distance, 1e-20f);
  nsvcd__add_to(&out->p1, inverse, nsvcd__f3_across(by_line, line));
  return by_normal;
}

// The adjoint of nsvcd__gap_facts, and of the facts about normals: by (FACTS), added to `out` and,
// by axis 1, to `seen`. moves: 0 at rest, else 1.
static void nsvcd__by_gaps(const nsvcd__tape *tape, float moves, const float *by,
                           nsvcd__by_pair *out, nsvcd__by_view *seen) {
  const nsvcd__pair *pair = &tape->pair;
  const nsvcd__view *view = &tape->view;
  const nsvcd__f3 *u = tape->axes;
  const nsvcd__f3 fixed = pair->normal[1];
  nsvcd__f3 by_u[NSVCD__GAPS];
  memset(by_u, 0, sizeof by_u);
  for (size_t m = 0; m < NSVCD__MOMENTS; m++) {
    const float tau = view->time * ((float)m - 1);
    const float *wide = tape->gaps[m];
    size_t widest = 0;
    for (size_t d = 1; d < NSVCD__GAPS; d++) widest = wide[d] > wide[widest] ? d : widest;
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      const float size = fabsf(view->inverse * wide[d]);
      const float own = by[NSVCD__FACT_GAPS + NSVCD__MOMENTS * d + m];
      const float most = d == widest ? by[NSVCD__FACT_WIDEST + m] : 0;
      const float by_own = nsvcd__by_gap_fact(own, size, NSVCD__GAP_STEEP);
      const float by_most = nsvcd__by_gap_fact(most, size, NSVCD__WIDEST_STEEP);
      const float by_gap = view->inverse * (by_own + by_most);
      const nsvcd__f3 more =
          nsvcd__by_gap(pair, tape->extremes, u[d], tau, moves, by_gap, out);
      nsvcd__add_to(&by_u[d], 1, more);
    }
  }

  nsvcd__f3 by_normal = nsvcd__by_gap_axes(pair, view, u, by_u, out);
  const float *facing = by + NSVCD__FACT_FACING;
  const float to_moving = view->swap > 0 ? facing[1] : facing[2];
  const float to_fixed = view->swap > 0 ? facing[2] : facing[1];
  nsvcd__add_to(&by_normal, facing[0], fixed);
  nsvcd__add_to(&by_normal, to_moving, view->frame.x);
  nsvcd__add_to(&seen->axis1, to_moving, view->normal);
  nsvcd__add_to(&seen->axis1, to_fixed, fixed);
  nsvcd__add_to(&out->rotation, 1, nsvcd__f3_cross(view->normal, by_normal));
}

// The adjoint of nsvcd__invariants. The unit of length is taken as constant.
static void nsvcd__by_invariants(const nsvcd__tape *tape, nsvcd__by_pair *by) {
  const nsvcd__view view = tape->view;
  const float *x = tape->x;
  const float *by_x = tape->by_x;
  // The direction of time; 0 at rest, to rounding: the logit is even in the motion, with a kink
  // there, and the mean of its two sides is 0.
  const float moves = nsvcd__f3_dot(view.v, view.v) + nsvcd__f3_dot(view.w, view.w);
  const float sign = moves < 1e-12f ? 0.0f : view.time * view.swap;

  // torques in the frame: on the moving patch's latent, then on all that the frame sees
  const size_t facts = 2 * NSVCD__LATENT;
  const size_t first = view.swap > 0 ? 0 : NSVCD__VECTORS;
  const size_t second = NSVCD__VECTORS - first;
  const nsvcd__f3 on_moving = nsvcd__latent_torque(x + first, by_x + first);
  const nsvcd__f3 on_fixed = nsvcd__latent_torque(x + second, by_x + second);
  nsvcd__by_view seen;
  memset(&seen, 0, sizeof seen);
  seen.torque = nsvcd__f3_add(on_moving, on_fixed);
  nsvcd__by_facts(&view, x + facts, by_x + facts, &seen);
  memset(by, 0, sizeof *by);
  nsvcd__by_gaps(tape, fabsf(sign), by_x + facts, by, &seen);
  nsvcd__by_frame(&view, &seen);

  const nsvcd__f3 lean1 = nsvcd__f3_scale(view.normal, view.swap * view.k1);
  const nsvcd__f3 turned = nsvcd__f3_scale(on_moving, view.side);
  nsvcd__add_transpose(&by->rotation, &view.frame, turned);
  nsvcd__add_to(&by->rotation, 1, nsvcd__f3_cross(lean1, seen.lean));
  nsvcd__add_to(&by->p1, -view.swap * view.inverse, seen.d);
  nsvcd__add_to(&by->v, sign * view.inverse, seen.v);
  nsvcd__add_to(&by->w, sign, seen.w);
}
#endif  // NSVCD_NO_GRADIENT
