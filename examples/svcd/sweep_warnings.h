// sweep_warnings.h - svcd sweep: are the sizes of A and B, and A's way, likely those in metres?
#ifndef NSVCD_SVCD_SWEEP_WARNINGS_H
#define NSVCD_SVCD_SWEEP_WARNINGS_H

#include "settings.h"

// Warns of what is wrong with both; of sizes with a --scale that leaves the other one as it is. And
// if one may be in millimetres and the other not; a body file is always in metres.
static void warn_of_things(thing *a, thing *b, const float *scales) {
  thing *t[2] = {a, b};
  double extents[2];
  float likely[2];
  char advice[64];
  int is_told = 0;
  for (int i = 0; i < 2; i++) {
    extents[i] = 0;
    for (int k = 0; k < 3; k++) extents[i] = fmax(extents[i], t[i]->high[k] - t[i]->low[k]);
    likely[i] = t[i]->is_body ? scales[i] : (float)mesh_likely_scale(&t[i]->report);
    is_told |= likely[i] != scales[i];
  }
  const int n = snprintf(advice, sizeof advice, "%g", (double)likely[0]);
  if (likely[0] != likely[1])
    snprintf(advice + n, sizeof advice - (size_t)n, ",%g", (double)likely[1]);
  for (int i = 0; i < 2; i++) {
    t[i]->report.advice = advice;
    if (!t[i]->is_body) mesh_find_size(&t[i]->report, t[i]->faults[0]);  // it is the first
    warn_of(t[i], t[i]->grave);
    t[i]->report.advice = NULL;
  }
  const int large = extents[1] > extents[0];
  const double times = extents[large] / extents[!large];
  if (times < 1000 || t[large]->is_body || is_told) return;
  complain("warning: %s is %.0f times as large as %s: is it in millimetres? try --scale %g,%g",
           t[large]->path, times, t[!large]->path, (double)scales[0] * (large ? 1 : 0.001),
           (double)scales[1] * (large ? 0.001 : 1));
}

// Warns if A is far from B on all of its way, as by poses in the unit of the files. Between two
// poses its origin moves on a line, so that a ball about it bounds what is between.
static void warn_of_way(const thing *a, const thing *b, const motion *m) {
  double middle[3], size_a[3], size_b[3], reach[3];
  double nearest = HUGE_VAL;
  for (int k = 0; k < 3; k++) {
    middle[k] = (b->low[k] + b->high[k]) / 2;
    size_a[k] = a->high[k] - a->low[k];
    size_b[k] = b->high[k] - b->low[k];
    reach[k] = fmax(a->high[k], -a->low[k]);
  }
  for (size_t i = 0; i < m->count; i++) {
    double from[3], way[3];
    oracle_sub(middle, m->poses[i].position, from);
    oracle_sub(m->poses[i + (i + 1 < m->count)].position, m->poses[i].position, way);
    const double along = oracle_dot(from, way) / fmax(oracle_dot(way, way), 1e-300);
    const double share = fmax(0, fmin(1, along));
    for (int k = 0; k < 3; k++) from[k] -= share * way[k];
    nearest = fmin(nearest, oracle_length(from));
  }
  const double sizes = oracle_length(size_a) + oracle_length(size_b);
  nearest -= oracle_length(reach) + oracle_length(size_b) / 2;
  if (!(nearest > 100 * sizes)) return;
  const double digit = pow(10, floor(log10(nearest)) - 2);  // three, rounded down
  complain(
      "warning: A is never nearer than %.3g m to B: are the poses in millimetres? they are in "
      "metres, whatever --scale says",
      floor(nearest / digit) * digit);
}

#endif
