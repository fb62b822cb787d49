// In, out: rotations, as values: quat and mat3 of floats, dquat and dmat3 of doubles. A matrix is
// its rows. A transform is a rotation and a position.
#pragma once
#include "angles.h"
#include "points.h"

// The algebra of both: NSVCD__ROTATIONS writes nsvcd__quat_dot, nsvcd__mat3_apply and so on.
//   _fma(s, b, a)        s b + a
//   _axis, _inverse      of a unit quaternion; the axis times the sine of half its angle
//   _mul(a, b)           the rotation by b, then by a
//   _turn(a, b)          from a to b, both unit: the axis, times the sine of half the angle
//   _along(a, b, arc, u) the slerp from a to b, which are that arc apart, at fraction u: of any
//                        length. Up to the arc `least` a line is as good, to rounding
//   _of                  the matrix of a unit quaternion
//   _apply_transpose     the transpose of m, times a
//   _transform           rotation a + position
#define NSVCD__ROTATIONS(quat, mat, placed, vec, scalar, sqrt, sin, least) \
  typedef struct quat { \
    scalar x, y, z, w; \
  } quat; \
  typedef struct mat { \
    vec x, y, z; \
  } mat; \
  typedef struct placed { \
    mat rotation; \
    vec position; \
  } placed; \
  static inline scalar quat##_dot(quat a, quat b) { \
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; \
  } \
  static inline quat quat##_scale(quat q, scalar s) { \
    const quat out = {q.x * s, q.y * s, q.z * s, q.w * s}; \
    return out; \
  } \
  static inline quat quat##_fma(scalar s, quat b, quat a) { \
    const quat out = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z, a.w + s * b.w}; \
    return out; \
  } \
  NSVCD__FORCE_INLINE quat quat##_unit(quat q) { \
    return quat##_scale(q, 1 / sqrt(quat##_dot(q, q))); \
  } \
  static inline vec quat##_axis(quat q) { \
    return vec##_of(q.x, q.y, q.z); \
  } \
  static inline quat quat##_inverse(quat q) { \
    const quat out = {-q.x, -q.y, -q.z, q.w}; \
    return out; \
  } \
  static inline quat quat##_mul(quat a, quat b) { \
    quat out; \
    out.x = a.w * b.x + a.x * b.w + (a.y * b.z - a.z * b.y); \
    out.y = a.w * b.y + a.y * b.w + (a.z * b.x - a.x * b.z); \
    out.z = a.w * b.z + a.z * b.w + (a.x * b.y - a.y * b.x); \
    out.w = a.w * b.w - (a.x * b.x + a.y * b.y + a.z * b.z); \
    return out; \
  } \
  static inline vec quat##_turn(quat a, quat b) { \
    return quat##_axis(quat##_mul(b, quat##_inverse(a))); \
  } \
  static inline quat quat##_along(quat a, quat b, scalar arc, scalar u) { \
    const int bends = arc > least; \
    const scalar before = bends ? sin((1 - u) * arc) : 1 - u; \
    const scalar after = bends ? sin(u * arc) : u; \
    return quat##_fma(after, b, quat##_scale(a, before)); \
  } \
  NSVCD__UNFUSED mat mat##_of(quat q) { \
    mat m; \
    m.x.x = 1 - 2 * (q.y * q.y + q.z * q.z); \
    m.x.y = 2 * (q.x * q.y - q.z * q.w); \
    m.x.z = 2 * (q.x * q.z + q.y * q.w); \
    m.y.x = 2 * (q.x * q.y + q.z * q.w); \
    m.y.y = 1 - 2 * (q.x * q.x + q.z * q.z); \
    m.y.z = 2 * (q.y * q.z - q.x * q.w); \
    m.z.x = 2 * (q.x * q.z - q.y * q.w); \
    m.z.y = 2 * (q.y * q.z + q.x * q.w); \
    m.z.z = 1 - 2 * (q.x * q.x + q.y * q.y); \
    return m; \
  } \
  static inline mat mat##_transpose(mat m) { \
    const mat out = {vec##_of(m.x.x, m.y.x, m.z.x), vec##_of(m.x.y, m.y.y, m.z.y), \
                     vec##_of(m.x.z, m.y.z, m.z.z)}; \
    return out; \
  } \
  static inline vec mat##_apply(const mat *m, vec a) { \
    return vec##_of(vec##_dot(m->x, a), vec##_dot(m->y, a), vec##_dot(m->z, a)); \
  } \
  static inline vec mat##_apply_transpose(const mat *m, vec a) { \
    const mat back = mat##_transpose(*m); \
    return mat##_apply(&back, a); \
  } \
  static inline vec vec##_transform(const placed *t, vec a) { \
    return vec##_add(mat##_apply(&t->rotation, a), t->position); \
  }
NSVCD__ROTATIONS(nsvcd__quat, nsvcd__mat3, nsvcd__transform, nsvcd__f3, float, sqrtf,
                 nsvcd__sinf, 1e-3f)
NSVCD__ROTATIONS(nsvcd__dquat, nsvcd__dmat3, nsvcd__dtransform, nsvcd__d3, double, sqrt,
                 nsvcd__sin, 1e-7)
#undef NSVCD__ROTATIONS

static inline nsvcd__dmat3 nsvcd__dmat3_scale(const nsvcd__dmat3 *m, double s) {
  const nsvcd__dmat3 out = {nsvcd__d3_scale(m->x, s), nsvcd__d3_scale(m->y, s),
                            nsvcd__d3_scale(m->z, s)};
  return out;
}

// ---- quaternions and matrices of floats

static inline nsvcd__quat nsvcd__quat_of(float x, float y, float z, float w) {
  const nsvcd__quat out = {x, y, z, w};
  return out;
}
static inline nsvcd__quat nsvcd__quat_load(const float *p) {
  return nsvcd__quat_of(p[0], p[1], p[2], p[3]);
}
// To rows of x, y, z and w, `stride` apart.
static inline void nsvcd__quat_put(nsvcd__quat q, float *rows, size_t stride) {
  rows[0] = q.x;
  rows[stride] = q.y;
  rows[2 * stride] = q.z;
  rows[3 * stride] = q.w;
}
static inline void nsvcd__quat_store(nsvcd__quat q, float *p) {
  nsvcd__quat_put(q, p, 1);
}

// Is the shorter arc from a to b the one to -b? Products of floats are exact in double, so every
// machine agrees, and so do poses in float and in double, even if both arcs are equally long to
// rounding.
static inline int nsvcd__quats_opposed(nsvcd__quat a, nsvcd__quat b) {
  double dot = (double)a.x * (double)b.x;
  dot = nsvcd__stored(dot + (double)a.y * (double)b.y);
  dot = nsvcd__stored(dot + (double)a.z * (double)b.z);
  dot = nsvcd__stored(dot + (double)a.w * (double)b.w);
  return dot < 0;
}

// The length of the arc from a to b in quaternion space: half the angle of rotation, in [0, pi/2]
// for the shorter arc. From the chord, because acos of a dot product near 1 has no digits left.
static inline float nsvcd__quat_arc(nsvcd__quat a, nsvcd__quat b) {
  const nsvcd__quat chord = nsvcd__quat_fma(-1, b, a);
  return 2 * nsvcd__asinf(0.5f * sqrtf(nsvcd__quat_dot(chord, chord)));
}

// The same rotation, negated if it is opposed to another quaternion.
static inline nsvcd__quat nsvcd__quat_beside(nsvcd__quat q, int opposed) {
  return opposed ? nsvcd__quat_of(-q.x, -q.y, -q.z, -q.w) : q;
}

// From a at u = 0 to b at u = 1, on the shorter arc. a, b: unit to 1e-4.
static inline nsvcd__quat nsvcd__quat_slerp(nsvcd__quat a, nsvcd__quat b, float u) {
  const int opposed = nsvcd__quats_opposed(a, b);
  const nsvcd__quat start = nsvcd__quat_unit(a);
  const nsvcd__quat end = nsvcd__quat_beside(nsvcd__quat_unit(b), opposed);
  const float arc = nsvcd__quat_arc(start, end);
  return nsvcd__quat_unit(nsvcd__quat_along(start, end, arc, u));
}

// s (a + t b).
static inline nsvcd__mat3 nsvcd__mat3_mix(float s, const nsvcd__mat3 *a, float t,
                                          const nsvcd__mat3 *b) {
  const nsvcd__mat3 out = {nsvcd__f3_scale(nsvcd__f3_fma(t, b->x, a->x), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->y, a->y), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->z, a->z), s)};
  return out;
}
