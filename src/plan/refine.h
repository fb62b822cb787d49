// In: control points. Out: better ones, by L-BFGS (Liu and Nocedal 1989) with bundled gradients
// (Suh et al. 2022).
//
// Difference from Liu and Nocedal: the initial inverse Hessian is half the inverse of the
// smoothness' form, not a multiple of the identity. It is exact where nothing collides.
#pragma once
#include "explore.h"

#ifndef NSVCD_NO_OPTIMIZER
static double nsvcd__dot(const float *a, const float *b, size_t count) {
  double sum = 0;
  for (size_t k = 0; k < count; k++) sum += (double)a[k] * (double)b[k];
  return sum;
}

// p->sum (M, F): the mean of the gradients at `control` + each offset of the bundle p->drawn.
static void nsvcd__bundled_gradient(nsvcd__planner *p, const nsvcd__stage *stage,
                                    const float *control) {
  const size_t f = p->in->joints;
  memset(p->sum, 0, stage->numbers * sizeof *p->sum);
  for (size_t n = 0; n < stage->draws && !p->error; n++) {
    nsvcd__change(p, stage, control, p->drawn + n * stage->numbers, 1, p->trial);
    nsvcd__cost_of(p, stage, p->trial, INFINITY, p->gradient);
    for (size_t k = 0; k < stage->numbers; k++)
      p->sum[k] += p->gradient[f + k] / (float)stage->draws;
  }
}

// The n-th step, or the n-th change of the gradient; the last HISTORY are kept.
static float *nsvcd__remembered(float *rows, size_t n, const nsvcd__stage *stage) {
  return rows + n % NSVCD__HISTORY * stage->numbers;
}

// p->offset (M, F): L-BFGS's direction for the gradient p->sum, by its two loops over the `kept`
// steps before step `next`.
static void nsvcd__direction(nsvcd__planner *p, const nsvcd__stage *stage, size_t kept,
                             size_t next) {
  const size_t numbers = stage->numbers;
  const size_t f = p->in->joints;
  double alpha[NSVCD__HISTORY];
  float *d = p->offset;
  for (size_t k = 0; k < numbers; k++) d[k] = -p->sum[k];
  for (size_t n = 1; n <= kept; n++) {
    const float *s = nsvcd__remembered(p->steps, next - n, stage);
    const float *y = nsvcd__remembered(p->changes, next - n, stage);
    alpha[n - 1] = nsvcd__dot(s, d, numbers) / nsvcd__dot(s, y, numbers);
    for (size_t k = 0; k < numbers; k++) d[k] -= (float)alpha[n - 1] * y[k];
  }
  for (size_t j = 0; j < f; j++) {
    for (size_t k = 0; k < stage->via; k++) p->vector[k] = (double)d[k * f + j];
    nsvcd__solve_lower(stage->factor, stage->via, p->vector);
    nsvcd__solve_upper(stage->factor, stage->via, p->vector);
    for (size_t k = 0; k < stage->via; k++) d[k * f + j] = 0.5f * (float)p->vector[k];
  }
  for (size_t n = kept; n > 0; n--) {
    const float *s = nsvcd__remembered(p->steps, next - n, stage);
    const float *y = nsvcd__remembered(p->changes, next - n, stage);
    const double beta = nsvcd__dot(y, d, numbers) / nsvcd__dot(s, y, numbers);
    for (size_t k = 0; k < numbers; k++) d[k] += (float)(alpha[n - 1] - beta) * s[k];
  }
}

// L-BFGS, from p->best on, which it improves. Ends early if the cost does not fall even along the
// direction that remembers no step.
static void nsvcd__refine(nsvcd__planner *p) {
  static const float lengths[NSVCD__STEPS] = {1, 0.5f, 0.2f, 0.05f, 0.01f};
  const nsvcd__stage *stage = &p->refine;
  const size_t f = p->in->joints;
  const size_t numbers = stage->numbers;
  float deviations[NSVCD_MAX_JOINTS];
  size_t kept = 0;  // steps, before step `next`
  size_t next = 0;
  int stuck = 0;
  nsvcd__cost best = nsvcd__cost_of(p, stage, p->best, INFINITY, NULL);

  // The same offsets in each iteration: then gradients differ only by where they are taken.
  for (size_t j = 0; j < f; j++) deviations[j] = stage->noise;
  for (size_t n = 0; n < stage->draws; n++)
    nsvcd__smooth_noise(p, stage, deviations, p->drawn + n * numbers);

  for (size_t i = 0; i < stage->iterations && !stuck && !p->cancelled && !p->error; i++) {
    const float before = best.total;
    memcpy(p->control, p->best, stage->bytes);
    nsvcd__bundled_gradient(p, stage, p->control);
    if (kept > 0) {
      // `change` holds minus the gradient before the last step. The step is forgotten if the
      // gradient does not grow along it: the inverse Hessian stays positive definite.
      const float *step = nsvcd__remembered(p->steps, next - 1, stage);
      float *change = nsvcd__remembered(p->changes, next - 1, stage);
      for (size_t k = 0; k < numbers; k++) change[k] += p->sum[k];
      const int grows = nsvcd__dot(step, change, numbers) > 1e-12;
      next -= !grows;
      kept -= !grows;
    }
    nsvcd__direction(p, stage, kept, next);
    for (size_t n = 0; n < NSVCD__STEPS && !p->error; n++) {
      nsvcd__change(p, stage, p->control, p->offset, lengths[n], p->trial);
      const nsvcd__cost cost = nsvcd__cost_of(p, stage, p->trial, best.total, NULL);
      if (!(cost.total < best.total)) continue;
      best = cost;
      memcpy(p->best, p->trial, stage->bytes);
    }
    if (best.total < before) {
      float *step = nsvcd__remembered(p->steps, next, stage);
      float *change = nsvcd__remembered(p->changes, next, stage);
      for (size_t k = 0; k < numbers; k++) {
        step[k] = p->best[f + k] - p->control[f + k];
        change[k] = -p->sum[k];
      }
      next++;
      kept += kept < NSVCD__HISTORY;
    } else {
      stuck = kept == 0;
      kept = 0;
    }
    nsvcd__report(p, i, stage, &best);
  }
}
#endif  // NSVCD_NO_OPTIMIZER
