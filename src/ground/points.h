// In, out: vectors of three numbers, as values: f3 of floats, d3 of doubles. A box is two corners.
#pragma once
#include "bits.h"

// The greater, or the lesser, of two; b if one is NaN. fmax and fmin, which handle NaN, are calls
// with most compilers.
static inline double nsvcd__max(double a, double b) {
  return a > b ? a : b;
}
static inline double nsvcd__min(double a, double b) {
  return a < b ? a : b;
}

// The algebra of f3 and of d3: NSVCD__VECTORS(nsvcd__f3, float, sqrtf) writes nsvcd__f3_add and so
// on. _load and _row read floats, three to a row; _fma(s, b, a) is s b + a, rounded twice. In
// double, differences of floats and what is built of a few of them are practically exact.
#define NSVCD__VECTORS(t, scalar, sqrt) \
  typedef struct t { \
    scalar x, y, z; \
  } t; \
  static inline t t##_of(scalar x, scalar y, scalar z) { \
    const t out = {x, y, z}; \
    return out; \
  } \
  static inline t t##_load(const float *p) { \
    return t##_of((scalar)p[0], (scalar)p[1], (scalar)p[2]); \
  } \
  static inline t t##_row(const float *rows, size_t i) { \
    return t##_load(rows + 3 * i); \
  } \
  static inline t t##_add(t a, t b) { \
    return t##_of(a.x + b.x, a.y + b.y, a.z + b.z); \
  } \
  static inline t t##_sub(t a, t b) { \
    return t##_of(a.x - b.x, a.y - b.y, a.z - b.z); \
  } \
  static inline t t##_scale(t a, scalar s) { \
    return t##_of(s * a.x, s * a.y, s * a.z); \
  } \
  static inline t t##_fma(scalar s, t b, t a) { \
    return t##_of(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z); \
  } \
  static inline t t##_min(t a, t b) { \
    return t##_of(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z); \
  } \
  static inline t t##_max(t a, t b) { \
    return t##_of(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z); \
  } \
  static inline scalar t##_dot(t a, t b) { \
    return a.x * b.x + a.y * b.y + a.z * b.z; \
  } \
  static inline t t##_cross(t a, t b) { \
    return t##_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); \
  } \
  static inline scalar t##_norm(t a) { \
    return sqrt(t##_dot(a, a)); \
  }
NSVCD__VECTORS(nsvcd__f3, float, sqrtf)
NSVCD__VECTORS(nsvcd__d3, double, sqrt)
#undef NSVCD__VECTORS

// ---- floats

// From, and to, rows of x, y and z, `stride` apart.
static inline nsvcd__f3 nsvcd__f3_get(const float *rows, size_t stride) {
  return nsvcd__f3_of(rows[0], rows[stride], rows[2 * stride]);
}
static inline void nsvcd__f3_put(nsvcd__f3 a, float *rows, size_t stride) {
  rows[0] = a.x;
  rows[stride] = a.y;
  rows[2 * stride] = a.z;
}
static inline void nsvcd__f3_store(nsvcd__f3 a, float *p) {
  nsvcd__f3_put(a, p, 1);
}
// Is any component of a greater than b's?
static inline int nsvcd__f3_exceeds(nsvcd__f3 a, nsvcd__f3 b) {
  return (a.x > b.x) | (a.y > b.y) | (a.z > b.z);
}

// A box along the axes.
typedef struct nsvcd__box {
  nsvcd__f3 low, high;
} nsvcd__box;

// Component 0, 1 or 2.
static inline double nsvcd__d3_axis(nsvcd__d3 a, size_t axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
static inline void nsvcd__d3_set_axis(nsvcd__d3 *a, size_t axis, double to) {
  *(axis == 0 ? &a->x : axis == 1 ? &a->y : &a->z) = to;
}
// The axis of the greatest component; of equals the first.
static inline size_t nsvcd__d3_longest(nsvcd__d3 a) {
  if (a.y > a.x && a.y >= a.z) return 1;
  return a.z > a.x ? 2 : 0;
}
static inline nsvcd__d3 nsvcd__d3_over(nsvcd__d3 a, double s) {
  return nsvcd__d3_of(a.x / s, a.y / s, a.z / s);
}
static inline nsvcd__f3 nsvcd__d3_narrow(nsvcd__d3 a) {
  return nsvcd__f3_of((float)a.x, (float)a.y, (float)a.z);
}
// a + t (b - a).
static inline nsvcd__d3 nsvcd__d3_mix(nsvcd__d3 a, nsvcd__d3 b, double t) {
  return nsvcd__d3_add(a, nsvcd__d3_scale(nsvcd__d3_sub(b, a), t));
}
static inline double nsvcd__d3_distance2(nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 offset = nsvcd__d3_sub(a, b);
  return nsvcd__d3_dot(offset, offset);
}
// Of length 1; `otherwise` if a is 0.
static inline nsvcd__d3 nsvcd__d3_unit(nsvcd__d3 a, nsvcd__d3 otherwise) {
  const double length = nsvcd__d3_norm(a);
  return length > 0 ? nsvcd__d3_scale(a, 1 / length) : otherwise;
}
// Rounds for certain. gcc 12 at -O2 drops both conversions where two neighbouring doubles become
// floats and doubles again, and a proof built on the stored floats would not hold. clang 14 for
// WebAssembly, in turn, reads a volatile number that fills a vector a second time, when it may have
// been overwritten.
static inline float nsvcd__to_float(double x) {
#ifdef __wasm_simd128__
  return (float)x;
#else
  volatile float rounded = (float)x;
  return rounded;
#endif
}
static inline nsvcd__f3 nsvcd__f3_round(nsvcd__d3 a) {
  return nsvcd__f3_of(nsvcd__to_float(a.x), nsvcd__to_float(a.y), nsvcd__to_float(a.z));
}
static inline nsvcd__d3 nsvcd__d3_widen(nsvcd__f3 a) {
  return nsvcd__d3_of((double)a.x, (double)a.y, (double)a.z);
}
// Rounded to double where registers are wider (x87), so that it equals itself computed again.
static inline double nsvcd__stored(double x) {
#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1
  return x;
#else
  volatile double rounded = x;
  return rounded;
#endif
}
static inline nsvcd__d3 nsvcd__d3_stored(nsvcd__d3 a) {
  return nsvcd__d3_of(nsvcd__stored(a.x), nsvcd__stored(a.y), nsvcd__stored(a.z));
}
