// In: points. Out: some of them, whose hull inflated by a margin contains all.
#pragma once
#include "../ground/spheres.h"
#include "balls.h"

#ifndef NSVCD_NO_ENCODER
// The point of a simplex nearest to the origin: weights are positive and sum to 1.
typedef struct nsvcd__simplex {
  nsvcd__d3 points[4];
  double weights[4];
  size_t count;
} nsvcd__simplex;

// Moves the weights to the simplex's point nearest to the origin, and drops corners that it does
// not need (Wolfe 1976, "Finding the nearest point in a polytope"). 0 if roundings prevent that;
// the weights are valid even then.
static int nsvcd__simplex_solve(nsvcd__simplex *s) {
  for (;;) {
    // weights, of any sign, of the point nearest to the origin in the plane of all corners
    nsvcd__d3 edges[3];
    double target[4] = {1};
    if (!nsvcd__solve_weights(s->points, s->count, 0, edges, target + 1)) return 0;
    for (size_t i = 1; i < s->count; i++) target[0] -= target[i];
    double fraction = 1;
    size_t blocking = s->count;
    for (size_t i = 0; i < s->count; i++) {
      const double weight = s->weights[i];
      if (target[i] > 0) continue;
      const double to_zero = weight > 0 ? weight / (weight - target[i]) : 0;
      if (to_zero > fraction) continue;
      fraction = to_zero;
      blocking = i;
    }
    for (size_t i = 0; i < s->count; i++)
      s->weights[i] += fraction * (target[i] - s->weights[i]);
    if (blocking == s->count) return 1;
    s->count--;
    s->points[blocking] = s->points[s->count];
    s->weights[blocking] = s->weights[s->count];
  }
}

// The distance from a point to a point of the convex hull of vertices. It is not less than the
// distance from the hull, and at most 0.2 % above it, but for roundings or if it is below `enough`.
// About ten steps are usual; on x87, whose registers have more digits than memory, it could seem to
// improve for ever. *from: from the point to one of the hull, where the search begins; becomes the
// one that was found, with the roundings of both searches.
static double nsvcd__hull_distance(nsvcd__points hull, nsvcd__d3 point, double enough,
                                   nsvcd__d3 *from) {
  nsvcd__simplex s;
  s.points[0] = *from;
  s.weights[0] = 1;
  s.count = 1;
  nsvcd__d3 nearest = s.points[0];
  double best = nsvcd__d3_dot(nearest, nearest);
  for (int step = 0; step < 64 && best > enough * enough && s.count < 4; step++) {
    const double offset = nsvcd__d3_dot(point, nearest);
    double least = HUGE_VAL;
    size_t support = 0;
    for (size_t i = 0; i < hull.count; i++) {
      const double at = nsvcd__d3_dot(hull.at[i], nearest) - offset;
      if (at < least) support = i;
      least = at < least ? at : least;
    }
    if (least >= 0.998 * best) break;
    s.points[s.count] = nsvcd__d3_sub(hull.at[support], point);
    s.weights[s.count++] = 0;
    const int is_solved = nsvcd__simplex_solve(&s);
    nearest = nsvcd__d3_scale(s.points[0], s.weights[0]);
    for (size_t i = 1; i < s.count; i++)
      nearest = nsvcd__d3_fma(s.weights[i], s.points[i], nearest);
    const double squared = nsvcd__d3_dot(nearest, nearest);
    if (!is_solved || squared >= best) break;
    best = squared;
    *from = nearest;
  }
  return sqrt(best);
}

// Chooses at most `most` (up to NSVCD__HULL) of the points so that all are near their hull: all of
// them if they are not more; else always the point farthest from the hull, until that is within
// `enough`. points: about the ball's centre. bounds: working memory, the last distance found of
// each point; it remains a bound, for the hull only grows. nearest: working memory, where that is.
// Writes the numbers of those chosen and the farthest distance; returns how many are chosen.
static size_t nsvcd__choose_hull(nsvcd__points points, size_t most, double enough,
                                 double *bounds, nsvcd__d3 *nearest, size_t *chosen,
                                 double *farthest) {
  nsvcd__d3 at[NSVCD__HULL];
  nsvcd__points hull = {at, 0};
  size_t next = 0;
  double most_distant = 0;
  *farthest = 0;
  if (points.count <= most) {
    for (size_t i = 0; i < points.count; i++) chosen[i] = i;
    return points.count;
  }
  for (size_t i = 0; i < points.count; i++) {
    // the first is the farthest from the centre
    const double distance = nsvcd__d3_norm(points.at[i]);
    if (distance > most_distant) next = i;
    most_distant = nsvcd__max(most_distant, distance);
    bounds[i] = HUGE_VAL;
  }
  *farthest = HUGE_VAL;
  while (*farthest > enough && hull.count < most) {
    at[hull.count] = points.at[next];
    chosen[hull.count++] = next;
    bounds[next] = 0;
    for (size_t i = 0; hull.count == 1 && i < points.count; i++)
      nearest[i] = nsvcd__d3_sub(at[0], points.at[i]);
    size_t first = 0;
    for (size_t i = 1; i < points.count; i++) first = bounds[i] > bounds[first] ? i : first;
    *farthest = 0;
    for (size_t k = 0; k < points.count; k++) {
      const size_t i = (first + k) % points.count;
      if (bounds[i] <= *farthest) continue;
      bounds[i] = nsvcd__hull_distance(hull, points.at[i], *farthest, &nearest[i]);
      if (bounds[i] <= *farthest) continue;
      *farthest = bounds[i];
      next = i;
    }
  }
  return hull.count;
}
#endif  // NSVCD_NO_ENCODER
