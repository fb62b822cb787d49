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

// The derivative of a decoder's logit by its inputs: x, by_x (DECODER_IN). A ReLU's derivative at 0
// is 0.
static NSVCD__APART void nsvcd__decoder_gradient(const nsvcd__decoder *decoder, const float *x,
                                                 float *by_x) {
  // what comes out of the layers, but for the last
  float values[5][NSVCD__WIDEST];
  float by[NSVCD__MOST_INPUTS] = {1};
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
  nsvcd__f3 d, lean, v, w;
  nsvcd__mat3 frame;
  float side;
} nsvcd__view;

// The derivative of a logit by what the frame sees, and the torque on that, in the frame.
typedef struct nsvcd__by_view {
  nsvcd__f3 d, v, w, lean, torque;
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
  nsvcd__f3 by_e1 = nsvcd__f3_scale(e3, by->torque.y + about * nsvcd__f3_dot(e1, a));
  by_e1 = nsvcd__f3_fma(-by->torque.z, e2, by_e1);
  if (length > 1e-5f)
    by->d = nsvcd__f3_fma(1 / length, by_e1, by->d);
  else if (nsvcd__f3_length(line) > 1e-9f)
    by->lean = nsvcd__f3_fma(1 / nsvcd__f3_length(line), by_e1, by->lean);
}

// The adjoint of nsvcd__invariants for the pair in lane 0. x, by_x (DECODER_IN). The unit of length
// is constant.
static NSVCD__APART void nsvcd__by_invariants(const nsvcd__pairs *pairs, const float *x,
                                              const float *by_x, nsvcd__by_pair *by) {
  nsvcd__views views;
  nsvcd__view view;
  nsvcd__mat3 rotation;
  nsvcd__views_of(pairs, 1, &views);
  nsvcd__first_lanes(&views, sizeof view / sizeof(float), &view);
  nsvcd__first_lanes(&pairs->rotation, 9, &rotation);
  // Which way time runs. 0 at rest, to rounding: the logit is even in the motion, with a kink
  // there, and the mean of its two sides is 0.
  const float same_v = nsvcd__f3_dot(view.v, nsvcd__first_f3(pairs->v)) * view.inverse;
  const float same = same_v + nsvcd__f3_dot(view.w, nsvcd__first_f3(pairs->w));
  const float sign = fabsf(same) < 1e-12f ? 0.0f : same < 0 ? -1.0f : 1.0f;

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
  nsvcd__by_frame(&view, &seen);

  const nsvcd__f3 mean = nsvcd__mean_direction(pairs->z[0][0]);
  const nsvcd__f3 scaled = nsvcd__f3_scale(mean, view.swap * view.k1 / 127);
  const nsvcd__f3 lean1 = nsvcd__mat3_apply(&rotation, scaled);
  const nsvcd__f3 none = {0, 0, 0};
  const nsvcd__f3 turned = nsvcd__f3_scale(on_moving, view.side);
  by->rotation = nsvcd__add_along_rows(none, &view.frame, turned);
  by->rotation = nsvcd__f3_add(by->rotation, nsvcd__f3_cross(lean1, seen.lean));
  by->p1 = nsvcd__f3_scale(seen.d, -view.swap * view.inverse);
  by->v = nsvcd__f3_scale(seen.v, sign * view.inverse);
  by->w = nsvcd__f3_scale(seen.w, sign);
}
#endif  // NSVCD_NO_GRADIENT
