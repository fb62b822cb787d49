// In: the candidate that decided an answer. Out: its tape: what its derivative takes from vectors.
#pragma once
#include "opinion.h"

#ifndef NSVCD_NO_GRADIENT
// Lane 0 of each of so many slices: out (count).
static void nsvcd__first_lanes(const void *slices, size_t count, void *out) {
  for (size_t k = 0; k < count; k++) {
    nsvcd__v slice;
    float lanes[NSVCD__SLICE];
    memcpy(&slice, (const char *)slices + k * sizeof slice, sizeof slice);
    nsvcd__v_store(lanes, slice);
    memcpy((char *)out + k * sizeof *lanes, lanes, sizeof *lanes);
  }
}

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

// The derivative of a decoder's output by its inputs: x, by_x (DECODER_IN). A ReLU's derivative at
// 0 is 0.
static NSVCD__NOINLINE void nsvcd__decoder_gradient(const nsvcd__decoder *decoder,
                                                    size_t output, const float *x,
                                                    float *by_x) {
  // the outputs of all layers but the last
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
      // about half of the inputs are 0
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

// Writes a tape whose times are known.
static void nsvcd__record(const nsvcd__task *task, nsvcd__tape *tape) {
  const nsvcd__motion *m = &task->motion;
  nsvcd__candidate *c = &task->decisive->candidate;
  nsvcd__pairs pairs;
  nsvcd__views views;
  nsvcd__v3 axes[NSVCD__GAPS];
  nsvcd__v gaps[NSVCD__GAPS];
  int8_t extremes[2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE];
  nsvcd__pairs_of(task->moving, task->fixed, m, &c, 1, &pairs);
  nsvcd__views_of(&pairs, &views);
  nsvcd__first_lanes(&pairs, sizeof tape->pair / sizeof(float), &tape->pair);
  nsvcd__first_lanes(&views, sizeof tape->view / sizeof(float), &tape->view);
  nsvcd__gap_axes_of(&pairs, &views, axes);
  nsvcd__first_lanes(axes, 3 * NSVCD__GAPS, tape->axes);
  nsvcd__extremes_collect(&pairs, 1, extremes);
  for (size_t k = 0; k < NSVCD__MOMENTS; k++) {
    const nsvcd__v tau = nsvcd__v_scale(views.time, (float)k - 1);
    nsvcd__gaps_at(&pairs, axes, extremes, tau, gaps);
    nsvcd__first_lanes(gaps, NSVCD__GAPS, tape->gaps[k]);
  }
  for (size_t n = 0; n < 2; n++) tape->extremes[n] = pairs.extremes[n][0];

  const int of_logit = !nsvcd__of_distance(task);
  const size_t output = of_logit ? NSVCD__OUT_LOGIT : NSVCD__OUT_DISTANCE;
  const float unit = of_logit ? 1 : 0.1f * nsvcd__candidate_radius(task, c);
  nsvcd__invariants(&pairs, 1, tape->x);
  nsvcd__decoder_gradient(task->decisive->decoder, output, tape->x, tape->by_x);
  for (size_t k = 0; k < NSVCD__DECODER_IN; k++) tape->by_x[k] *= unit;

  const nsvcd__f3 own = nsvcd__centre_of(nsvcd__body_patches(task->moving), c->moving);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_scale(own, m->scale));
  nsvcd__f3 from_pivot = own;
  if (m->moving.pivot) from_pivot = nsvcd__f3_sub(own, nsvcd__f3_load(m->moving.pivot));
  const nsvcd__v3 arm = nsvcd__v3_set(nsvcd__f3_scale(from_pivot, m->scale));
  for (size_t first = 0; first < NSVCD__INSTANTS; first += NSVCD__SLICE) {
    const size_t left = NSVCD__INSTANTS - first;
    const size_t count = left < NSVCD__SLICE ? left : NSVCD__SLICE;
    const nsvcd__v_pose pose = nsvcd__v_poses_at(m, tape->at.t + first, count);
    const nsvcd__vmat3 rotation = nsvcd__vmat3_of(pose.rotation);
    nsvcd__v3_store(tape->at.arm, first, nsvcd__vmat3_apply(rotation, arm));
    const nsvcd__v3 to_centre = nsvcd__vmat3_apply(rotation, centre);
    nsvcd__v3_store(tape->at.position, first, nsvcd__v3_add(to_centre, pose.position));
  }
}
#endif  // NSVCD_NO_GRADIENT
