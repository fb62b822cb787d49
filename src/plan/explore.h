// In: control points. Out: better ones, by MPPI (Williams et al. 2017): their mean moves to that of
// smooth random changes, weighted by exp(-cost / temperature).
//
// Differences from the article: via points of a spline are changed, not the controls of a dynamic
// system; the temperature and the deviations of the changes follow the costs of the rollouts.
#pragma once
#include "../ground/random.h"
#include "cost.h"

#ifndef NSVCD_NO_OPTIMIZER
// A standard normal number: Box and Muller.
static double nsvcd__normal(nsvcd__planner *p) {
  const double size = nsvcd__random(&p->random);
  return sqrt(-2 * log(size)) * cos(6.283185307179586 * nsvcd__random(&p->random));
}

// A smooth random change of the via points, (M, F), zero at the ends. Its inverse covariance is the
// form of the smoothness, scaled: the largest standard deviation of a joint is deviations (F).
static void nsvcd__smooth_noise(nsvcd__planner *p, const nsvcd__stage *stage,
                                const float *deviations, float *out) {
  const size_t f = p->in->joints;
  const size_t via = stage->via;
  for (size_t j = 0; j < f; j++) {
    for (size_t k = 0; k < via; k++) p->vector[k] = nsvcd__normal(p);
    nsvcd__solve_upper(stage->factor, via, p->vector);
    const double scale = (double)deviations[j] / stage->deviation;
    for (size_t k = 0; k < via; k++) out[k * f + j] = (float)(scale * p->vector[k]);
  }
}

// out (M + 2, F) = control + scale * offset (M, F), with via points clamped to the limits.
static void nsvcd__change(const nsvcd__planner *p, const nsvcd__stage *stage,
                          const float *control, const float *offset, float scale, float *out) {
  const size_t f = p->in->joints;
  memcpy(out, control, stage->bytes);
  for (size_t k = 0; k < stage->numbers; k++) {
    const float x = control[f + k] + scale * offset[k];
    const float low = p->in->low[k % f];
    const float high = p->in->high[k % f];
    // NaN becomes `high`
    out[f + k] = x < low ? low : x < high ? x : high;
  }
}

// Counts an iteration, and reports to the caller, who may cancel the search.
static void nsvcd__report(nsvcd__planner *p, size_t iteration, const nsvcd__stage *stage,
                          const nsvcd__cost *best) {
  const int refining = stage == &p->refine;
  const nsvcd_plan_progress progress = {p->answer.seeds, iteration,   stage->iterations,
                                        refining,        best->total, best->collision,
                                        p->best,         stage->via};
  p->answer.iterations++;
  if (p->in->progress) p->cancelled = p->in->progress(p->in->user, &progress);
}

// Where MPPI is.
typedef struct nsvcd__exploring {
  float deviations[NSVCD_MAX_JOINTS];  // of the rollouts
  float temperature;                   // 0 at first
  float least;                         // cost of the last rollouts
  nsvcd__cost best;                    // of all
} nsvcd__exploring;

// Draws rollouts about p->control, and finds their costs; the best of all goes to p->best. The
// first has no offset, the second is the best so far, the others are noise.
static void nsvcd__roll_out(nsvcd__planner *p, nsvcd__exploring *at) {
  const nsvcd__stage *stage = &p->explore;
  const size_t f = p->in->joints;
  at->least = INFINITY;
  for (size_t n = 0; n < stage->draws; n++) {
    float *offset = p->drawn + n * stage->numbers;
    if (n > 0) nsvcd__smooth_noise(p, stage, at->deviations, offset);
    for (size_t k = 0; n < 2 && k < stage->numbers; k++)
      offset[k] = n > 0 ? p->best[f + k] - p->control[f + k] : 0;
    nsvcd__change(p, stage, p->control, offset, 1, p->trial);
    for (size_t k = 0; k < stage->numbers; k++)
      offset[k] = p->trial[f + k] - p->control[f + k];

    // The cost of a rollout that weighs nothing need not be exact.
    float limit = INFINITY;
    if (at->temperature > 0) limit = at->least + NSVCD__WEIGHTLESS * at->temperature;
    const nsvcd__cost cost = nsvcd__cost_of(p, stage, p->trial, limit, NULL);
    p->costs[n] = cost.total;
    if (cost.total < at->least) at->least = cost.total;
    if (cost.total >= at->best.total || cost.total > limit) continue;
    at->best = cost;
    memcpy(p->best, p->trial, stage->bytes);
  }
}

// Turns p->costs into weights, whose sum is 1; writes the mean of the offsets to p->sum; moves the
// variances a tenth of the way to twice those of the weighted rollouts about that mean.
static void nsvcd__weigh_rollouts(nsvcd__planner *p, nsvcd__exploring *at) {
  const nsvcd__stage *stage = &p->explore;
  const size_t f = p->in->joints;
  const size_t draws = stage->draws;
  const size_t rank = draws / NSVCD__ELITE;
  float elite = 0;  // the cost of that rank
  float total = 0;
  for (size_t i = 0; i < draws; i++) {
    size_t below = 0;
    size_t not_above = 0;
    for (size_t n = 0; n < draws; n++) {
      below += p->costs[n] < p->costs[i];
      not_above += p->costs[n] <= p->costs[i];
    }
    if (below <= rank && rank < not_above) elite = p->costs[i];
  }
  at->temperature = 0.5f * (elite - at->least) + 1e-6f * (1 + at->least);
  for (size_t n = 0; n < draws; n++) {
    p->costs[n] = expf((at->least - p->costs[n]) / at->temperature);
    total += p->costs[n];
  }
  memset(p->sum, 0, stage->numbers * sizeof *p->sum);
  for (size_t n = 0; n < draws; n++) {
    const float weight = p->costs[n] / total;
    p->costs[n] = weight > 1e-9f ? weight : 0;
    for (size_t k = 0; weight > 1e-9f && k < stage->numbers; k++)
      p->sum[k] += weight * p->drawn[n * stage->numbers + k];
  }

  for (size_t j = 0; j < f; j++) {
    const float now = at->deviations[j];
    const float least = 1e-3f * p->first_noise[j] * p->first_noise[j];
    float square = 0;
    for (size_t n = 0; n < draws; n++) {
      for (size_t k = j; p->costs[n] > 0 && k < stage->numbers; k += f) {
        const float d = p->drawn[n * stage->numbers + k] - p->sum[k];
        square += p->costs[n] * d * d / (float)stage->via;
      }
    }
    const float variance = 0.9f * now * now + 0.1f * 2 * square;
    at->deviations[j] = sqrtf(variance > least ? variance : least);
  }
}

// MPPI, from the mean p->control on. Leaves the best trajectory in p->best.
static void nsvcd__explore(nsvcd__planner *p) {
  const nsvcd__stage *stage = &p->explore;
  nsvcd__exploring at;
  memset(&at, 0, sizeof at);
  at.best = nsvcd__cost_of(p, stage, p->control, INFINITY, NULL);
  memcpy(p->best, p->control, stage->bytes);
  memcpy(at.deviations, p->first_noise, sizeof at.deviations);
  float before = at.best.total;
  size_t waited = 0;
  for (size_t i = 0; i < stage->iterations && waited < NSVCD__PATIENCE; i++) {
    if (p->cancelled || p->error) break;
    nsvcd__roll_out(p, &at);
    if (p->error) break;
    nsvcd__weigh_rollouts(p, &at);
    nsvcd__change(p, stage, p->control, p->sum, NSVCD__MEAN_STEP, p->trial);
    memcpy(p->control, p->trial, stage->bytes);

    const int better = at.best.total < 0.99f * before;
    waited = !nsvcd__is_free(&at.best) || better ? 0 : waited + 1;
    before = better ? at.best.total : before;
    nsvcd__report(p, i, stage, &at.best);
  }
}
#endif  // NSVCD_NO_OPTIMIZER
