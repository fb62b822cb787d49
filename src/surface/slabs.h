// In: points. Out: a slab: a direction in which they are thin, and their extent along it and
// across.
#pragma once
#include "../ground/rotations.h"
#include "../ground/spheres.h"
#include "balls.h"

#ifndef NSVCD_NO_ENCODER
// An extent along a direction.
typedef struct nsvcd__drange {
  double low, high;
} nsvcd__drange;

static nsvcd__drange nsvcd__drange_along(nsvcd__points points, nsvcd__d3 direction) {
  nsvcd__drange range = {HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < points.count; i++) {
    const double at = nsvcd__d3_dot(points.at[i], direction);
    range.low = at < range.low ? at : range.low;
    range.high = at > range.high ? at : range.high;
  }
  return range;
}

static double nsvcd__thickness(nsvcd__points points, nsvcd__d3 direction) {
  const nsvcd__drange range = nsvcd__drange_along(points, direction);
  return range.high - range.low;
}

// A direction perpendicular to a unit vector.
static nsvcd__d3 nsvcd__any_across(nsvcd__d3 n) {
  const int x_least = fabs(n.x) <= fabs(n.y) && fabs(n.x) <= fabs(n.z);
  const int y_least = fabs(n.y) <= fabs(n.z);
  nsvcd__d3 axis = nsvcd__d3_of(0, 0, 1);
  if (y_least) axis = nsvcd__d3_of(0, 1, 0);
  if (x_least) axis = nsvcd__d3_of(1, 0, 0);
  return nsvcd__d3_unit(nsvcd__d3_cross(n, axis), n);
}

static double nsvcd__trace(const nsvcd__dmat3 *m) {
  return m->x.x + m->y.y + m->z.z;
}

static nsvcd__d3 nsvcd__longest_row(const nsvcd__dmat3 *m) {
  const double x = nsvcd__d3_dot(m->x, m->x);
  const double y = nsvcd__d3_dot(m->y, m->y);
  const double z = nsvcd__d3_dot(m->z, m->z);
  if (x >= y && x >= z) return m->x;
  return y >= z ? m->y : m->z;
}

// Roughly the direction in which the points vary least. The adjugate of their covariance has the
// same axes, and the least becomes the largest; squaring it a few times leaves only that.
static nsvcd__d3 nsvcd__least_axis(nsvcd__points points) {
  const nsvcd__d3 zero = nsvcd__d3_of(0, 0, 0);
  nsvcd__dmat3 c = {zero, zero, zero};
  nsvcd__d3 mean = zero;
  for (size_t i = 0; i < points.count; i++) mean = nsvcd__d3_add(mean, points.at[i]);
  mean = nsvcd__d3_scale(mean, 1 / (double)points.count);
  for (size_t i = 0; i < points.count; i++) {
    const nsvcd__d3 d = nsvcd__d3_sub(points.at[i], mean);
    c.x = nsvcd__d3_fma(d.x, d, c.x);
    c.y = nsvcd__d3_fma(d.y, d, c.y);
    c.z = nsvcd__d3_fma(d.z, d, c.z);
  }
  const nsvcd__d3 z = nsvcd__d3_of(0, 0, 1);
  const nsvcd__d3 along = nsvcd__d3_unit(nsvcd__longest_row(&c), z);
  const double size = nsvcd__trace(&c);
  nsvcd__dmat3 m;
  m.x = nsvcd__d3_cross(c.y, c.z);
  m.y = nsvcd__d3_cross(c.z, c.x);
  m.z = nsvcd__d3_cross(c.x, c.y);
  // a line
  if (!(nsvcd__trace(&m) > 1e-14 * size * size)) return nsvcd__any_across(along);
  for (size_t step = 0; step < 6; step++) {
    const double trace = nsvcd__trace(&m);
    nsvcd__dmat3 square;
    square.x = nsvcd__dmat3_apply(&m, m.x);
    square.y = nsvcd__dmat3_apply(&m, m.y);
    square.z = nsvcd__dmat3_apply(&m, m.z);
    m = nsvcd__dmat3_scale(&square, trace > 0 ? 1 / (trace * trace) : 0);
  }
  return nsvcd__d3_unit(nsvcd__longest_row(&m), nsvcd__any_across(along));
}

// Turns a direction in ever smaller steps to where the points are thinner, until they are `thin`.
static nsvcd__d3 nsvcd__thinner(nsvcd__points points, nsvcd__d3 direction, double thin) {
  double best = nsvcd__thickness(points, direction);
  for (double turn = 0.16; turn > 0.005 && best > thin; turn *= 0.5) {
    const nsvcd__d3 u = nsvcd__any_across(direction);
    const nsvcd__d3 v = nsvcd__d3_cross(direction, u);
    const nsvcd__d3 middle = direction;
    for (size_t k = 0; k < 4; k++) {
      const nsvcd__d3 step = nsvcd__d3_scale(k < 2 ? u : v, k % 2 ? -turn : turn);
      const nsvcd__d3 trial = nsvcd__d3_unit(nsvcd__d3_add(middle, step), middle);
      const double thickness = nsvcd__thickness(points, trial);
      if (thickness >= best) continue;
      best = thickness;
      direction = trial;
    }
  }
  return direction;
}

// Fits a slab to points about the centre of the patch's ball. normal: the mean normal of its
// pieces, of any length. thin: metres; a thinner slab is of no use.
static nsvcd__slab nsvcd__fit_slab(nsvcd__points points, nsvcd__d3 normal, double margin,
                                   double thin) {
  nsvcd__d3 best = nsvcd__least_axis(points);
  const nsvcd__d3 mean = nsvcd__d3_unit(normal, best);
  if (nsvcd__thickness(points, mean) < nsvcd__thickness(points, best)) best = mean;
  best = nsvcd__thinner(points, best, thin);
  if (nsvcd__d3_dot(best, normal) < 0) best = nsvcd__d3_scale(best, -1);

  // shorter than 1 by more than the roundings, so that |n| <= 1 as it is stored
  const nsvcd__f3 n = nsvcd__f3_round(nsvcd__d3_scale(best, 1 - 1.5e-7));
  const nsvcd__d3 stored = nsvcd__d3_widen(n);
  const nsvcd__drange range = nsvcd__drange_along(points, stored);
  double squared = 0;
  for (size_t i = 0; i < points.count; i++) {
    const nsvcd__d3 moment = nsvcd__d3_cross(points.at[i], stored);
    squared = nsvcd__max(squared, nsvcd__d3_dot(moment, moment));
  }
  const double across = sqrt(squared / nsvcd__d3_dot(stored, stored));
  nsvcd__slab slab;
  slab.normal = n;
  slab.low = -nsvcd__float_above(-(range.low - margin));
  slab.high = nsvcd__float_above(range.high + margin);
  slab.across = nsvcd__float_above(across * (1 + 1e-6) + margin);
  return slab;
}
#endif  // NSVCD_NO_ENCODER
