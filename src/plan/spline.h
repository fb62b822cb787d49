// In: control points (M + 2, F) of a spline. Out: the joints along it, their derivatives, and means
// of squares of these.
//
// Everything is linear in the control points, and the same for each joint: a joint at a time is the
// sum of its control points times weights (M + 2), and the mean of its square over the motion a
// quadratic form (M + 2, M + 2).
#pragma once
#include "../interface/plans.h"
#include "../ground/compiler.h"

#ifndef NSVCD_NO_OPTIMIZER
// The derivative of that order at u of a polynomial of degree 5, times `scale`.
static double nsvcd__polynomial(const double *coefficients, double u, size_t derivative,
                                double scale) {
  double value = 0;
  double power = scale;
  for (size_t n = derivative; n < 6; n++, power *= u) {
    double factor = coefficients[n];
    for (size_t d = 0; d < derivative; d++) factor *= (double)(n - d);
    value += factor * power;
  }
  return value;
}

// The weights (M + 2) of the control points in the derivative of that order by t, which is clamped
// to [0,1].
static void nsvcd__spline_weights(size_t via, double t, size_t derivative, double *weights) {
  // Hermite's polynomials of u in [0,1]: of the position, velocity and acceleration at its left
  // end, then at its right.
  static const double basis[6][6] = {{1, 0, 0, -10, 15, -6},       {0, 1, 0, -6, 8, -3},
                                     {0, 0, 0.5, -1.5, 1.5, -0.5}, {0, 0, 0, 10, -15, 6},
                                     {0, 0, 0, -4, 7, -3},         {0, 0, 0, 0.5, -1, 0.5}};
  const size_t last = via + 1;
  const double at = (t > 0 ? (t < 1 ? t : 1) : 0) * (double)last;
  const size_t left = (size_t)at < last ? (size_t)at : last - 1;
  const double u = at - (double)left;
  // derivatives by t, not by u
  double scale = 1;
  for (size_t k = 0; k < derivative; k++) scale *= (double)last;
  for (size_t k = 0; k <= last; k++) weights[k] = 0;
  for (size_t end = 0; end < 2; end++) {
    const double(*polynomials)[6] = basis + 3 * end;
    const size_t point = left + end;
    weights[point] += nsvcd__polynomial(polynomials[0], u, derivative, scale);
    // both ends of the motion are at rest
    if (point == 0 || point == last) continue;
    const double velocity = nsvcd__polynomial(polynomials[1], u, derivative, scale);
    const double acceleration = nsvcd__polynomial(polynomials[2], u, derivative, scale);
    weights[point + 1] += 0.5 * velocity + acceleration;
    weights[point - 1] += acceleration - 0.5 * velocity;
    weights[point] -= 2 * acceleration;
  }
}

NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out) {
  double weights[NSVCD_MAX_VIA_POINTS + 2];
  if (via_points > NSVCD_MAX_VIA_POINTS || derivative > 3) return;
  nsvcd__spline_weights(via_points, (double)t, derivative, weights);
  for (size_t j = 0; j < joints; j++) {
    double sum = 0;
    for (size_t k = 0; k < via_points + 2; k++)
      sum += weights[k] * (double)control[k * joints + j];
    out[j] = (float)sum;
  }
}

// Adds to the form (M + 2, M + 2) `weight` times the mean over t of the derivative's square. By
// Gauss-Legendre quadrature with five nodes a piece, which is exact: the squares are of degree 8 at
// most.
static void nsvcd__add_mean_square(size_t via, size_t derivative, double weight,
                                   double *form) {
  static const double nodes[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                  0.953089922969332};
  static const double gauss[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                  0.239314335249683, 0.118463442528095};
  const size_t count = via + 2;
  const double pieces = (double)(via + 1);
  double w[NSVCD_MAX_VIA_POINTS + 2];
  for (size_t piece = 0; piece < via + 1; piece++) {
    for (size_t n = 0; n < 5; n++) {
      const double t = ((double)piece + nodes[n]) / pieces;
      nsvcd__spline_weights(via, t, derivative, w);
      for (size_t i = 0; i < count; i++) {
        const double scaled = weight * gauss[n] / pieces * w[i];
        for (size_t j = 0; j < count; j++) form[i * count + j] += scaled * w[j];
      }
    }
  }
}

// Cholesky's factor L of a (n, n), symmetric and positive definite, in its lower triangle: L L^T =
// a. What rounding makes negative is taken as small and positive. The upper triangle stays.
static void nsvcd__cholesky(double *a, size_t n) {
  for (size_t i = 0; i < n; i++) {
    const double least = 1e-9 * a[i * n + i];
    for (size_t j = 0; j <= i; j++) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < j; k++) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = j < i ? sum / a[j * n + j] : sqrt(sum > least ? sum : least);
    }
  }
}
// x = L^-1 x
static void nsvcd__solve_lower(const double *l, size_t n, double *x) {
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < i; k++) x[i] -= l[i * n + k] * x[k];
    x[i] /= l[i * n + i];
  }
}
// x = L^-T x
static void nsvcd__solve_upper(const double *l, size_t n, double *x) {
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; k++) x[i] -= l[k * n + i] * x[k];
    x[i] /= l[i * n + i];
  }
}
#endif  // NSVCD_NO_OPTIMIZER
