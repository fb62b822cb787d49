// In: points, in double. Out: the centre of the least ball that contains them.
#pragma once
#include "../ground/points.h"

#ifndef NSVCD_NO_ENCODER
typedef struct nsvcd__points {
  const nsvcd__d3 *at;  // (count)
  size_t count;
} nsvcd__points;

typedef struct nsvcd__ball {
  nsvcd__d3 centre;
  double squared;  // radius
} nsvcd__ball;

// The edges from the first of 1 to 4 points to the others, and weights for them. The first point
// plus the weighted edges is the centre of the least ball with all points on its surface; or, if
// `ball` is 0, the point nearest to the origin in the plane (line, point) through them. 0 if the
// points are too nearly on a line or in a plane.
static int nsvcd__solve_weights(const nsvcd__d3 *points, size_t count, int ball,
                                nsvcd__d3 *edges, double *b) {
  const size_t n = count - 1;
  double a[3][3] = {{0}};
  double first[3];
  for (size_t i = 0; i < n; i++) {
    edges[i] = nsvcd__d3_sub(points[i + 1], points[0]);
    first[i] = nsvcd__d3_dot(edges[i], edges[i]);
    b[i] = ball ? 0.5 * first[i] : -nsvcd__d3_dot(edges[i], points[0]);
    for (size_t j = 0; j <= i; j++) a[j][i] = nsvcd__d3_dot(edges[i], edges[j]);
  }
  // most are of two points
  if (n == 1 && !(first[0] > 0)) return 0;
  if (n == 1) b[0] /= first[0];
  if (n == 1) return 1;
  // symmetric and positive definite: the upper half is enough, without pivoting
  for (size_t i = 0; i < n; i++) {
    if (!(a[i][i] > 1e-13 * first[i])) return 0;
    for (size_t j = i + 1; j < n; j++) {
      const double factor = a[i][j] / a[i][i];
      for (size_t k = j; k < n; k++) a[j][k] -= factor * a[i][k];
      b[j] -= factor * b[i];
    }
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t j = i + 1; j < n; j++) b[i] -= a[i][j] * b[j];
    b[i] /= a[i][i];
  }
  return 1;
}

// The least float that is not below x.
static NSVCD__NOINLINE float nsvcd__float_above(double x) {
  const float rounded = nsvcd__to_float(x);
  return (double)rounded < x ? nextafterf(rounded, HUGE_VALF) : rounded;
}

// The least ball with these 1 to 4 points on its surface. 0 if there is none.
static int nsvcd__ball_through(const nsvcd__d3 *points, size_t count, nsvcd__ball *ball) {
  nsvcd__d3 edges[3];
  double weights[3];
  if (!nsvcd__solve_weights(points, count, 1, edges, weights)) return 0;
  nsvcd__d3 offset = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i + 1 < count; i++) offset = nsvcd__d3_fma(weights[i], edges[i], offset);
  ball->centre = nsvcd__d3_add(points[0], offset);
  ball->squared = nsvcd__d3_dot(offset, offset);
  return 1;
}

// Up to five points, on a ball's surface or about to be.
typedef struct nsvcd__border {
  nsvcd__d3 points[5];
  size_t count;
} nsvcd__border;

// The least ball that contains the border (1 to 5 points), among those through its last point and
// up to three others. Keeps in the border only the points on the ball. 0 if there is none.
static NSVCD__NOINLINE int nsvcd__ball_of_few(nsvcd__border *border, nsvcd__ball *ball) {
  const unsigned last = 1u << (border->count - 1);
  unsigned best = 0;
  for (unsigned set = last; set < 2 * last; set++) {
    nsvcd__border chosen;
    nsvcd__ball trial;
    chosen.count = 0;
    for (size_t i = 0; i < border->count; i++) {
      if (set >> i & 1) chosen.points[chosen.count++] = border->points[i];
    }
    if (chosen.count > 4 || !nsvcd__ball_through(chosen.points, chosen.count, &trial))
      continue;
    int holds = !best || trial.squared < ball->squared;
    const double most = trial.squared * (1 + 1e-9);
    for (size_t i = 0; i < border->count; i++)
      holds &= nsvcd__d3_distance2(border->points[i], trial.centre) <= most;
    if (!holds) continue;
    best = set;
    *ball = trial;
  }
  if (!best) return 0;
  size_t kept = 0;
  for (size_t i = 0; i < border->count; i++) {
    if (best >> i & 1) border->points[kept++] = border->points[i];
  }
  border->count = kept;
  return 1;
}

// The centre of the least enclosing ball (after Gaertner 1999, "Fast and robust smallest enclosing
// balls"): the point farthest outside joins the border, until there is none. The ball grows with
// every step. Roundings can stop it early, and then the caller, who takes the radius from the
// points, has a ball that is a little too large.
static nsvcd__d3 nsvcd__ball_centre(nsvcd__points points) {
  nsvcd__ball ball = {points.at[0], 0};
  nsvcd__border border;
  border.points[0] = points.at[0];
  border.count = 1;
  for (size_t step = 0; step < 64; step++) {
    double most = -1;
    size_t farthest = 0;
    for (size_t i = 0; i < points.count; i++) {
      const double square = nsvcd__d3_distance2(points.at[i], ball.centre);
      if (square > most) farthest = i;
      most = nsvcd__max(most, square);
    }
    if (most <= ball.squared * (1 + 1e-9)) break;
    border.points[border.count++] = points.at[farthest];
    nsvcd__ball larger = ball;
    if (!nsvcd__ball_of_few(&border, &larger)) break;
    if (larger.squared <= ball.squared) break;
    ball = larger;
  }
  return ball.centre;
}
#endif  // NSVCD_NO_ENCODER
