// In: the pair that decided an answer. Out: the derivative of its logit by the poses. Reverse mode,
// step by step from the end, over one pair and in scalars; `by_x` is the derivative of the logit by
// x:
//
//   decoder     by the decoder's inputs
//   pair        by the line between the centres, the velocity, and the rotations, over the frame
//               and the facts
//   instants    by the moving body's poses at t_enter, t_exit and in the middle, and by these times
//   contact     from the times to the poses at the ends of the segment in which the balls meet or
//               part
//   poses       from the pose at any time to the caller's poses
//
// The derivative by the pose of a rigid body is a wrench: a force (by a displacement of its origin)
// and a torque (by a small rotation about that). A force f on a point at `arm` from the origin is
// that force, and the torque arm x f.
#pragma once
#include "../network/decoder.h"

#ifndef NSVCD_NO_GRADIENT
// The derivative of |a| by a, times `by`. At 0, to rounding, where it has none, it is nothing: the
// mean of all directions.
static nsvcd__f3 nsvcd__by_length(nsvcd__f3 a, float by) {
  const float length = nsvcd__f3_length(a);
  return nsvcd__f3_scale(a, length > 1e-6f ? by / length : 0);
}

// Lane 0 of so many slices, one after the other: out (count).
static void nsvcd__first_lanes(const void *slices, size_t count, void *out) {
  for (size_t k = 0; k < count; k++) {
    nsvcd__v slice;
    float lanes[NSVCD__SLICE];
    memcpy(&slice, (const char *)slices + k * sizeof slice, sizeof slice);
    nsvcd__v_store(lanes, slice);
    memcpy((char *)out + k * sizeof *lanes, lanes, sizeof *lanes);
  }
}
static nsvcd__f3 nsvcd__first_f3(nsvcd__v3 a) {
  nsvcd__f3 out;
  nsvcd__first_lanes(&a, 3, &out);
  return out;
}

// a without its part along the unit vector n.
static nsvcd__f3 nsvcd__f3_across(nsvcd__f3 a, nsvcd__f3 n) {
  return nsvcd__f3_fma(-nsvcd__f3_dot(a, n), n, a);
}

// a's part along the unit vector n (or 0), times `along`, and the rest, turned about n by `angle`,
// times `across`. All that commutes with rotations about n is of this kind.
static nsvcd__f3 nsvcd__turned(nsvcd__f3 a, nsvcd__f3 n, float along, float across,
                               float angle) {
  const float c = across * cosf(angle);
  const nsvcd__f3 side = nsvcd__f3_scale(n, across * sinf(angle));
  nsvcd__f3 sum = {0, 0, 0};
  sum = nsvcd__f3_fma(c, a, sum);
  sum = nsvcd__f3_fma((along - c) * nsvcd__f3_dot(n, a), n, sum);
  return nsvcd__f3_add(sum, nsvcd__f3_cross(side, a));
}

// ---- decoder

// The weights of a layer from input i to outputs o .. o + SLICE - 1.
NSVCD__INLINE nsvcd__v nsvcd__weights_at(const nsvcd__layer *layer, size_t i, size_t o) {
#ifndef NSVCD_NO_FLOAT
  return nsvcd__v_load(nsvcd_w_decoder + layer->weights + layer->outputs * i + o);
#else
  const size_t at = 4 * (layer->outputs * (i / 4) + o) + i % 4;
  const int8_t *w = nsvcd_w_decoder_int8 + layer->weights + at;
  const float *scale = nsvcd_w_decoder_scale + layer->first + o;
  float lanes[NSVCD__SLICE];
  for (size_t l = 0; l < NSVCD__SLICE; l++) lanes[l] = (float)w[4 * l] * scale[l];
  return nsvcd__v_load(lanes);
#endif
}

// The derivative of an output of a decoder by its inputs: x, by_x (DECODER_IN). A ReLU's derivative
// at 0 is 0.
static NSVCD__NOINLINE void nsvcd__decoder_gradient(const nsvcd__decoder *decoder,
                                                    size_t output, const float *x,
                                                    float *by_x) {
  // what comes out of the layers, but for the last
  float values[5][NSVCD__WIDEST];
  float by[NSVCD__MOST_INPUTS] = {0};
  by[output] = 1;
  const size_t last = decoder->layers - 1;
  for (size_t n = 0; n < last; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    const float *from = n > 0 ? values[n - 1] : x;
    float *y = values[n];
    memcpy(y, nsvcd_w_decoder_bias + layer.first, layer.outputs * sizeof *y);
    for (size_t i = 0; i < layer.inputs; i++) {
      // about half of them
      if (!(from[i] < 0 || from[i] > 0)) continue;
      const nsvcd__v input = nsvcd__v_set(from[i]);
      for (size_t o = 0; o < layer.outputs; o += NSVCD__SLICE) {
        const nsvcd__v w = nsvcd__weights_at(&layer, i, o);
        nsvcd__v_store(y + o, nsvcd__v_fma(input, w, nsvcd__v_load(y + o)));
      }
    }
    for (size_t o = 0; o < layer.outputs; o++) y[o] = y[o] > 0 ? y[o] : 0;
  }
  for (size_t n = last + 1; n-- > 0;) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    float by_inputs[NSVCD__MOST_INPUTS] = {0};
    for (size_t i = 0; i < layer.inputs; i++) {
      if (n > 0 && !(values[n - 1][i] > 0)) continue;
      float lanes[NSVCD__LANES];
      NSVCD__EACH_SLICE(l) {
        nsvcd__v sum = nsvcd__v_set(0);
        for (size_t o = l; o < layer.outputs; o += NSVCD__LANES) {
          const nsvcd__v w = nsvcd__weights_at(&layer, i, o);
          sum = nsvcd__v_fma(w, nsvcd__v_load(by + o), sum);
        }
        nsvcd__v_store(lanes + l, sum);
      }
      for (size_t k = 0; k < NSVCD__LANES; k++) by_inputs[i] += lanes[k];
    }
    memcpy(by, by_inputs, layer.inputs * sizeof *by);
  }
  memcpy(by_x, by, NSVCD__DECODER_IN * sizeof *by_x);
}

// ---- pair

// The derivative by a small rotation of a latent's vectors, as they are (x) and the derivative by
// them (by), both (3, CHANNELS), then (5, CHANNELS). On degree 2, in the basis of nsvcd__degree2, a
// rotation by w adds to q
//   (wy q1 - wx q3 + 2 wz q4, wz q3 - wy q0 - wx (r q2 + q4), r (wx q1 - wy q3),
//    wx q0 - wz q1 + wy (r q2 - q4), wx q1 + wy q3 - 2 wz q0), r being the root of 3.
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
    const nsvcd__f3 degree1 = nsvcd__f3_cross(nsvcd__f3_load(q - 3), nsvcd__f3_load(h - 3));
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

// The derivative of a logit by a pair, as nsvcd__pairs has it, in the fixed body's axes and units.
typedef struct nsvcd__by_pair {
  nsvcd__f3 p1, v, w;
  // by a small rotation of the moving patch about its centre
  nsvcd__f3 rotation;
} nsvcd__by_pair;

// A pair in its own units: what nsvcd__views has in lane 0, number by number.
typedef struct nsvcd__view {
  float inverse, k1, k2, swap;
  nsvcd__f3 d, lean, normal;
  float time;
  nsvcd__f3 v, w;
  nsvcd__mat3 frame;
  float side;
} nsvcd__view;

// The derivative of a logit by what the frame sees, by axis 1, and the torque on all of that, in
// the frame.
typedef struct nsvcd__by_view {
  nsvcd__f3 d, v, w, lean, axis1, torque;
} nsvcd__by_view;

// sum + the rows of m, times the components of a.
static nsvcd__f3 nsvcd__add_along_rows(nsvcd__f3 sum, const nsvcd__mat3 *m, nsvcd__f3 a) {
  sum = nsvcd__f3_fma(a.x, m->x, sum);
  sum = nsvcd__f3_fma(a.y, m->y, sum);
  return nsvcd__f3_fma(a.z, m->z, sum);
}

// The adjoint of the facts: by (FACTS), added to `out`.
static void nsvcd__by_facts(const nsvcd__view *view, const float *facts, const float *by,
                            nsvcd__by_view *out) {
  const float tau = facts[NSVCD__FACT_TAU];
  const float scale = 1 / (nsvcd__f3_dot(view->v, view->v) + 1e-6f);
  const nsvcd__f3 closest = nsvcd__f3_sub(view->d, nsvcd__f3_scale(view->v, tau));
  const nsvcd__f3 by_distance = nsvcd__by_length(view->d, by[NSVCD__FACT_DISTANCE]);
  const nsvcd__f3 by_closest = nsvcd__by_length(closest, by[NSVCD__FACT_CLOSEST]);
  out->d = nsvcd__f3_add(out->d, by_distance);
  out->d = nsvcd__f3_add(out->d, by_closest);
  out->v = nsvcd__f3_fma(-tau, by_closest, out->v);
  // else it is clamped
  if (fabsf(tau) < 1) {
    const float direct = by[NSVCD__FACT_TAU];
    const float by_tau = scale * (direct - nsvcd__f3_dot(by_closest, view->v));
    out->d = nsvcd__f3_fma(by_tau, view->v, out->d);
    out->v = nsvcd__f3_fma(by_tau, view->d, out->v);
    out->v = nsvcd__f3_fma(-2 * by_tau * tau, view->v, out->v);
  }

  const nsvcd__f3 velocity = nsvcd__f3_load(facts + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 turn = nsvcd__f3_load(facts + NSVCD__FACT_TURN);
  const nsvcd__f3 by_velocity = nsvcd__f3_load(by + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 by_turn = nsvcd__f3_load(by + NSVCD__FACT_TURN);
  const nsvcd__f3 mirrored = nsvcd__f3_scale(by_turn, view->side);
  out->v = nsvcd__add_along_rows(out->v, &view->frame, by_velocity);
  out->w = nsvcd__add_along_rows(out->w, &view->frame, mirrored);
  out->torque = nsvcd__f3_add(out->torque, nsvcd__f3_cross(velocity, by_velocity));
  out->torque = nsvcd__f3_add(out->torque, nsvcd__f3_cross(turn, by_turn));
  out->v = nsvcd__f3_add(out->v, nsvcd__by_length(view->v, by[NSVCD__FACT_SPEED]));
  out->w = nsvcd__f3_add(out->w, nsvcd__by_length(view->w, by[NSVCD__FACT_SPIN]));
}

// The adjoint of the frame in nsvcd__views_of, whose conventions are constant between its switches,
// added to `by`. Turning the frame does the opposite of turning all that it sees.
static void nsvcd__by_frame(const nsvcd__view *view, nsvcd__by_view *by) {
  const nsvcd__f3 e1 = view->frame.x;
  const nsvcd__f3 e2 = view->frame.y;
  const nsvcd__f3 e3 = view->frame.z;
  const float length = nsvcd__f3_length(view->d);
  const nsvcd__f3 line = nsvcd__f3_of(view->lean.x + 1e-6f, view->lean.y, view->lean.z);

  // Axis 2: of what is across axis 1, of a reference a.
  nsvcd__f3 a = nsvcd__f3_add(nsvcd__f3_scale(view->lean, NSVCD__LEAN), view->v);
  nsvcd__f3 across = nsvcd__f3_sub(a, nsvcd__f3_scale(e1, nsvcd__f3_dot(a, e1)));
  const int vanishes = nsvcd__f3_length(across) <= 1e-7f;
  if (vanishes) {
    // the coordinate axis farthest from e1
    const float x = fabsf(e1.x);
    const float y = fabsf(e1.y);
    const float z = fabsf(e1.z);
    a = y <= z ? nsvcd__f3_of(0, 1, 0) : nsvcd__f3_of(0, 0, 1);
    if (x <= y && x <= z) a = nsvcd__f3_of(1, 0, 0);
    across = nsvcd__f3_sub(a, nsvcd__f3_scale(e1, nsvcd__f3_dot(a, e1)));
  }
  const float about = by->torque.x / nsvcd__f3_length(across);
  if (!vanishes) {
    by->v = nsvcd__f3_fma(-about, e3, by->v);
    by->lean = nsvcd__f3_fma(-about * NSVCD__LEAN, e3, by->lean);
  }

  // Axis 1: of the line, or of what stands for it.
  nsvcd__f3 by_e1 = nsvcd__f3_across(by->axis1, e1);
  by_e1 = nsvcd__f3_fma(by->torque.y + about * nsvcd__f3_dot(e1, a), e3, by_e1);
  by_e1 = nsvcd__f3_fma(-by->torque.z, e2, by_e1);
  if (length > 1e-5f)
    by->d = nsvcd__f3_fma(1 / length, by_e1, by->d);
  else if (nsvcd__f3_length(line) > 1e-9f)
    by->lean = nsvcd__f3_fma(1 / nsvcd__f3_length(line), by_e1, by->lean);
}

// ---- gaps

// What the axis of a gap is the direction of: a constant, plus so many times the moving patch's
// normal, reversed, and the unit vector of the line between the centres.
typedef struct nsvcd__gap_axis {
  float of_moving, of_line;
  float length;  // of that sum
} nsvcd__gap_axis;

// Of the axes that nsvcd__gap_axes_of makes.
static void nsvcd__gap_axes_made(nsvcd__f3 fixed, const nsvcd__view *view, nsvcd__f3 line,
                                 nsvcd__gap_axis *made) {
  const nsvcd__gap_axis constant = {0, 0, 1};
  const nsvcd__gap_axis against = {1, 0, 1};
  const nsvcd__gap_axis along = {0, 1, 1};
  const int has_fixed = nsvcd__f3_length(fixed) > 0.5f;
  const int has_moving = nsvcd__f3_length(view->normal) > 0.5f;
  const nsvcd__gap_axis of_fixed = has_fixed ? constant : along;
  const nsvcd__gap_axis of_moving = has_moving ? against : along;
  const nsvcd__f3 from = has_fixed ? fixed : line;
  const nsvcd__f3 to = has_moving ? nsvcd__f3_scale(view->normal, -1) : line;
  nsvcd__gap_axis both = {of_moving.of_moving, of_fixed.of_line + of_moving.of_line,
                          nsvcd__f3_length(nsvcd__f3_add(from, to))};
  if (!(both.length > 1e-3f)) both = along;
  made[NSVCD__GAP_LARGER] = view->swap > 0 ? of_moving : of_fixed;
  made[NSVCD__GAP_SMALLER] = view->swap > 0 ? of_fixed : of_moving;
  made[NSVCD__GAP_LINE] = along;
  made[NSVCD__GAP_BOTH] = both;
}

// As nsvcd__turned_back, whose adjoint by u it is too, with -w.
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
  out = nsvcd__f3_fma(half * nsvcd__f3_dot(w, q), u, out);
  out = nsvcd__f3_fma(half * nsvcd__f3_dot(u, w), q, out);
  return nsvcd__f3_fma(-2 * half * nsvcd__f3_dot(u, q), w, out);
}

// Of a body's extremes, from the first on, the farthest along u, in steps.
static nsvcd__f3 nsvcd__farthest_extreme(const int8_t *extremes, nsvcd__f3 u) {
  nsvcd__f3 best = {0, 0, 0};
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__GROUP) {
    const nsvcd__f3 extreme =
        nsvcd__f3_of(extremes[0], extremes[NSVCD__GROUP], extremes[2 * NSVCD__GROUP]);
    if (k == 0 || nsvcd__f3_dot(extreme, u) > nsvcd__f3_dot(best, u)) best = extreme;
  }
  return best;
}

// Lane 0 of what gaps are measured of.
typedef struct nsvcd__gap_pair {
  nsvcd__f3 between, v, w;
  float radii[2];
  nsvcd__mat3 rotation;
  const int8_t *extremes[2];
} nsvcd__gap_pair;

// The adjoint of a gap along u at tau, times `by`, added to `out`, and returned by u. moves: 0 at
// rest, else 1.
static nsvcd__f3 nsvcd__by_gap(const nsvcd__gap_pair *pair, nsvcd__f3 u, float tau,
                               float moves, float by, nsvcd__by_pair *out) {
  const float half = 0.5f * tau;
  const nsvcd__f3 w = pair->w;
  const nsvcd__f3 minus = nsvcd__f3_scale(w, -1);
  const nsvcd__f3 back = nsvcd__f3_turned_back(u, w, half);
  const nsvcd__f3 forth = nsvcd__f3_turned_back(u, w, -half);
  const nsvcd__f3 own = nsvcd__mat3_apply_transpose(&pair->rotation, back);
  const nsvcd__f3 lowest =
      nsvcd__farthest_extreme(pair->extremes[0], nsvcd__f3_scale(own, -1));
  const nsvcd__f3 highest = nsvcd__farthest_extreme(pair->extremes[1], forth);
  const nsvcd__f3 turned = nsvcd__mat3_apply(&pair->rotation, lowest);
  const nsvcd__f3 q = nsvcd__f3_scale(turned, pair->radii[0] / 127);
  const nsvcd__f3 x = nsvcd__f3_scale(highest, pair->radii[1] / 127);
  const nsvcd__f3 on_q = nsvcd__turned_back_by_w(u, w, half, q);
  const nsvcd__f3 on_x = nsvcd__turned_back_by_w(u, w, -half, x);
  out->p1 = nsvcd__f3_fma(by, u, out->p1);
  out->v = nsvcd__f3_fma(moves * tau * by, u, out->v);
  out->w = nsvcd__f3_fma(moves * by, nsvcd__f3_sub(on_q, on_x), out->w);
  out->rotation = nsvcd__f3_fma(by, nsvcd__f3_cross(q, back), out->rotation);
  nsvcd__f3 apart = nsvcd__f3_fma(tau, pair->v, pair->between);
  apart = nsvcd__f3_add(apart, nsvcd__f3_turned_back(q, minus, half));
  apart = nsvcd__f3_sub(apart, nsvcd__f3_turned_back(x, minus, -half));
  return nsvcd__f3_scale(apart, by);
}

// The adjoint of nsvcd__tell_gaps, and of the facts about normals: by (FACTS), added to `out` and,
// by axis 1, to `seen`. view: lane 0 of views. moves: 0 at rest, else 1.
static NSVCD__NOINLINE void nsvcd__by_gaps(const nsvcd__pairs *pairs,
                                           const nsvcd__views *views, const nsvcd__view *view,
                                           float moves, const float *by, nsvcd__by_pair *out,
                                           nsvcd__by_view *seen) {
  const nsvcd__f3 fixed = nsvcd__first_f3(pairs->normal[1]);
  nsvcd__gap_pair pair;
  nsvcd__gap_axes axes;
  nsvcd__gap_axis made[NSVCD__GAPS];
  nsvcd__f3 by_u[NSVCD__GAPS];
  int8_t extremes[2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE];
  pair.between = nsvcd__f3_sub(nsvcd__first_f3(pairs->p1), nsvcd__first_f3(pairs->p2));
  pair.v = nsvcd__first_f3(pairs->v);
  pair.w = nsvcd__first_f3(pairs->w);
  pair.extremes[0] = pairs->extremes[0][0];
  pair.extremes[1] = pairs->extremes[1][0];
  nsvcd__first_lanes(&pairs->r1, 1, &pair.radii[0]);
  nsvcd__first_lanes(&pairs->r2, 1, &pair.radii[1]);
  nsvcd__first_lanes(&pairs->rotation, 9, &pair.rotation);
  nsvcd__gap_axes_of(pairs, views, &axes);
  nsvcd__extremes_collect(pairs, 1, extremes);
  memset(by_u, 0, sizeof by_u);
  for (size_t m = 0; m < NSVCD__MOMENTS; m++) {
    const float tau = view->time * ((float)m - 1);
    nsvcd__v at[NSVCD__GAPS];
    float wide[NSVCD__GAPS];
    size_t widest = 0;
    nsvcd__gaps_at(pairs, &axes, extremes, nsvcd__v_set(tau), at);
    nsvcd__first_lanes(at, NSVCD__GAPS, wide);
    for (size_t d = 1; d < NSVCD__GAPS; d++) widest = wide[d] > wide[widest] ? d : widest;
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      const float gap = fabsf(view->inverse * wide[d]);
      const float steep = NSVCD__GAP_STEEP;
      const float steeper = d == widest ? NSVCD__WIDEST_STEEP : 0;
      const float told = by[NSVCD__FACT_GAPS + NSVCD__MOMENTS * d + m];
      const float by_told = told * steep / ((1 + steep * gap) * (1 + steep * gap));
      const float by_widest =
          by[NSVCD__FACT_WIDEST + m] * steeper / ((1 + steeper * gap) * (1 + steeper * gap));
      const float by_gap = view->inverse * (by_told + by_widest);
      const nsvcd__f3 u = nsvcd__first_f3(axes.u[d]);
      const nsvcd__f3 more = nsvcd__by_gap(&pair, u, tau, moves, by_gap, out);
      by_u[d] = nsvcd__f3_add(by_u[d], more);
    }
  }

  // By the axes, to what they are made of.
  const nsvcd__f3 line = nsvcd__first_f3(axes.u[NSVCD__GAP_LINE]);
  const float length = fmaxf(nsvcd__f3_length(pair.between), 1e-20f);
  nsvcd__f3 by_moving = {0, 0, 0};
  nsvcd__f3 by_line = {0, 0, 0};
  nsvcd__gap_axes_made(fixed, view, line, made);
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__f3 across = nsvcd__f3_across(by_u[d], nsvcd__first_f3(axes.u[d]));
    by_moving = nsvcd__f3_fma(-made[d].of_moving / made[d].length, across, by_moving);
    by_line = nsvcd__f3_fma(made[d].of_line / made[d].length, across, by_line);
  }
  out->p1 = nsvcd__f3_fma(1 / length, nsvcd__f3_across(by_line, line), out->p1);

  const float *facing = by + NSVCD__FACT_FACING;
  const float to_moving = view->swap > 0 ? facing[1] : facing[2];
  const float to_fixed = view->swap > 0 ? facing[2] : facing[1];
  by_moving = nsvcd__f3_fma(facing[0], fixed, by_moving);
  by_moving = nsvcd__f3_fma(to_moving, view->frame.x, by_moving);
  seen->axis1 = nsvcd__f3_fma(to_moving, view->normal, seen->axis1);
  seen->axis1 = nsvcd__f3_fma(to_fixed, fixed, seen->axis1);
  out->rotation = nsvcd__f3_add(out->rotation, nsvcd__f3_cross(view->normal, by_moving));
}

// The adjoint of nsvcd__invariants for the pair in lane 0. x, by_x (DECODER_IN). The unit of length
// is constant.
static NSVCD__NOINLINE void nsvcd__by_invariants(const nsvcd__pairs *pairs, const float *x,
                                                 const float *by_x, nsvcd__by_pair *by) {
  nsvcd__views views;
  nsvcd__view view;
  nsvcd__views_of(pairs, &views);
  nsvcd__first_lanes(&views, sizeof view / sizeof(float), &view);
  // Which way time runs. 0 at rest, to rounding: the logit is even in the motion, with a kink
  // there, and the mean of its two sides is 0.
  const float moves = nsvcd__f3_dot(view.v, view.v) + nsvcd__f3_dot(view.w, view.w);
  const float sign = moves < 1e-12f ? 0.0f : view.time * view.swap;

  // Torques in the frame: on the moving patch's latent, then on all that the frame sees.
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
  nsvcd__by_gaps(pairs, &views, &view, fabsf(sign), by_x + facts, by, &seen);
  nsvcd__by_frame(&view, &seen);

  const nsvcd__f3 lean1 = nsvcd__f3_scale(view.normal, view.swap * view.k1);
  const nsvcd__f3 turned = nsvcd__f3_scale(on_moving, view.side);
  by->rotation = nsvcd__add_along_rows(by->rotation, &view.frame, turned);
  by->rotation = nsvcd__f3_add(by->rotation, nsvcd__f3_cross(lean1, seen.lean));
  by->p1 = nsvcd__f3_fma(-view.swap * view.inverse, seen.d, by->p1);
  by->v = nsvcd__f3_fma(sign * view.inverse, seen.v, by->v);
  by->w = nsvcd__f3_fma(sign, seen.w, by->w);
}
#endif  // NSVCD_NO_GRADIENT
