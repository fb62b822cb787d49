// In: angles up to a quarter turn, and lengths. Out: sines, and angles. By libm; with
// NSVCD_ONE_PATH computed here, because libm's last digit differs between machines.
#pragma once
#include "compiler.h"

#ifdef NSVCD_ONE_PATH
// sin x for 0 <= x <= pi / 2, to 1e-15: the rest of the series is below 2e-18.
static inline double nsvcd__sin(double x) {
  const double square = x * x;
  double sum = 1;
  for (int n = 20; n > 0; n -= 2) sum = 1 - sum * (square / (n * (n + 1)));
  return x * sum;
}
// The angle of a vector (x, y), x, y >= 0, to 1e-15. tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a))
// halves it twice, to below 0.2, where the rest of the series is below 1e-18.
static inline double nsvcd__atan2(double y, double x) {
  const int steep = y > x;
  const double slope = steep ? x / y : x > 0 ? y / x : 0;
  double t = slope;
  double sum = 0;
  for (int n = 0; n < 2; n++) t = t / (1 + sqrt(1 + t * t));
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n - sum * (t * t);
  return steep ? 1.57079632679489662 - 4 * t * sum : 4 * t * sum;
}
static inline float nsvcd__sinf(float x) {
  return (float)nsvcd__sin((double)x);
}
// For 0 <= x < 1.
static inline float nsvcd__asinf(float x) {
  const double sine = (double)x;
  return (float)nsvcd__atan2(sine, sqrt(1 - sine * sine));
}
#else
#define nsvcd__sin sin
#define nsvcd__atan2 atan2
#define nsvcd__sinf sinf
#define nsvcd__asinf asinf
#endif
