// In, out: rotations, lane by lane: vquat is a slice of quaternions, vmat3 of matrices.
#pragma once
#include "../ground/rotations.h"
#include "lanes.h"

typedef struct nsvcd__vquat {
  nsvcd__v x, y, z, w;
} nsvcd__vquat;

// Matrices by their rows.
typedef struct nsvcd__vmat3 {
  nsvcd__v3 x, y, z;
} nsvcd__vmat3;

NSVCD__INLINE nsvcd__vquat nsvcd__vquat_of(nsvcd__v3 axis, nsvcd__v w) {
  const nsvcd__vquat out = {axis.x, axis.y, axis.z, w};
  return out;
}
// The axis of a unit quaternion, times the sine of half its angle.
NSVCD__INLINE nsvcd__v3 nsvcd__vquat_axis(nsvcd__vquat q) {
  return nsvcd__v3_of(q.x, q.y, q.z);
}
NSVCD__INLINE nsvcd__vquat nsvcd__vquat_set(nsvcd__quat q) {
  return nsvcd__vquat_of(nsvcd__v3_set(nsvcd__f3_of(q.x, q.y, q.z)), nsvcd__v_set(q.w));
}
// From rows of x, y, z and w, `stride` apart.
NSVCD__INLINE nsvcd__vquat nsvcd__vquat_load(const float *p, size_t stride) {
  return nsvcd__vquat_of(nsvcd__v3_get(p, stride), nsvcd__v_load(p + 3 * stride));
}
NSVCD__INLINE void nsvcd__vquat_store(nsvcd__vquat q, float *p, size_t stride) {
  nsvcd__v3_put(nsvcd__vquat_axis(q), p, stride);
  nsvcd__v_store(p + 3 * stride, q.w);
}
static inline nsvcd__v nsvcd__vquat_dot(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v sum = nsvcd__v_fma(a.y, b.y, nsvcd__v_mul(a.x, b.x));
  return nsvcd__v_fma(a.w, b.w, nsvcd__v_fma(a.z, b.z, sum));
}
// a + s b.
static inline nsvcd__vquat nsvcd__vquat_fma(nsvcd__v s, nsvcd__vquat b, nsvcd__vquat a) {
  return nsvcd__vquat_of(nsvcd__v3_fma(s, nsvcd__vquat_axis(b), nsvcd__vquat_axis(a)),
                         nsvcd__v_fma(s, b.w, a.w));
}
static inline nsvcd__vquat nsvcd__vquat_unit(nsvcd__vquat q) {
  const nsvcd__v length = nsvcd__v_sqrt(nsvcd__vquat_dot(q, q));
  const nsvcd__vquat out = {nsvcd__v_div(q.x, length), nsvcd__v_div(q.y, length),
                            nsvcd__v_div(q.z, length), nsvcd__v_div(q.w, length)};
  return out;
}
// Of unit quaternions.
static inline nsvcd__vquat nsvcd__vquat_inverse(nsvcd__vquat q) {
  return nsvcd__vquat_of(nsvcd__v3_negate(nsvcd__vquat_axis(q)), q.w);
}
static inline nsvcd__vquat nsvcd__vquat_mul(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v3 u = nsvcd__vquat_axis(a);
  const nsvcd__v3 v = nsvcd__vquat_axis(b);
  const nsvcd__v3 along = nsvcd__v3_fma(a.w, v, nsvcd__v3_scale(u, b.w));
  const nsvcd__v cosines = nsvcd__v_mul(a.w, b.w);
  return nsvcd__vquat_of(nsvcd__v3_add(nsvcd__v3_cross(u, v), along),
                         nsvcd__v_sub(cosines, nsvcd__v3_dot(u, v)));
}

NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_rows(nsvcd__v3 x, nsvcd__v3 y, nsvcd__v3 z) {
  const nsvcd__vmat3 out = {x, y, z};
  return out;
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_set(const nsvcd__mat3 *m) {
  const nsvcd__vmat3 out = {nsvcd__v3_set(m->x), nsvcd__v3_set(m->y), nsvcd__v3_set(m->z)};
  return out;
}
// p: (9, LANES), row-major.
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_load(nsvcd__row *p, size_t l) {
  return nsvcd__vmat3_rows(nsvcd__v3_load(p, l), nsvcd__v3_load(p + 3, l),
                           nsvcd__v3_load(p + 6, l));
}
NSVCD__INLINE void nsvcd__vmat3_store(nsvcd__row *p, size_t l, nsvcd__vmat3 m) {
  nsvcd__v3_store(p, l, m.x);
  nsvcd__v3_store(p + 3, l, m.y);
  nsvcd__v3_store(p + 6, l, m.z);
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_scale(nsvcd__vmat3 m, nsvcd__v s) {
  return nsvcd__vmat3_rows(nsvcd__v3_scale(m.x, s), nsvcd__v3_scale(m.y, s),
                           nsvcd__v3_scale(m.z, s));
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_sub(nsvcd__vmat3 a, nsvcd__vmat3 b) {
  return nsvcd__vmat3_rows(nsvcd__v3_sub(a.x, b.x), nsvcd__v3_sub(a.y, b.y),
                           nsvcd__v3_sub(a.z, b.z));
}
// a + s b.
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_fma(nsvcd__v s, nsvcd__vmat3 b, nsvcd__vmat3 a) {
  return nsvcd__vmat3_rows(nsvcd__v3_fma(s, b.x, a.x), nsvcd__v3_fma(s, b.y, a.y),
                           nsvcd__v3_fma(s, b.z, a.z));
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_transpose(nsvcd__vmat3 m) {
  return nsvcd__vmat3_rows(nsvcd__v3_of(m.x.x, m.y.x, m.z.x),
                           nsvcd__v3_of(m.x.y, m.y.y, m.z.y),
                           nsvcd__v3_of(m.x.z, m.y.z, m.z.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__vmat3_apply(nsvcd__vmat3 m, nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v3_dot(m.x, a), nsvcd__v3_dot(m.y, a), nsvcd__v3_dot(m.z, a));
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_mul(nsvcd__vmat3 a, nsvcd__vmat3 b) {
  const nsvcd__vmat3 columns = nsvcd__vmat3_transpose(b);
  return nsvcd__vmat3_rows(nsvcd__vmat3_apply(columns, a.x), nsvcd__vmat3_apply(columns, a.y),
                           nsvcd__vmat3_apply(columns, a.z));
}
// p + m a.
NSVCD__INLINE nsvcd__v3 nsvcd__vmat3_apply_add(nsvcd__vmat3 m, nsvcd__v3 a, nsvcd__v3 p) {
  return nsvcd__v3_of(nsvcd__v3_dot_add(m.x, a, p.x), nsvcd__v3_dot_add(m.y, a, p.y),
                      nsvcd__v3_dot_add(m.z, a, p.z));
}
// The squared Frobenius norm.
NSVCD__INLINE nsvcd__v nsvcd__vmat3_square(nsvcd__vmat3 m) {
  const nsvcd__v sum = nsvcd__v3_dot_add(m.x, m.x, nsvcd__v_set(0));
  return nsvcd__v3_dot_add(m.z, m.z, nsvcd__v3_dot_add(m.y, m.y, sum));
}
// The transpose of m, times a.
NSVCD__INLINE nsvcd__v3 nsvcd__vmat3_apply_transpose(nsvcd__vmat3 m, nsvcd__v3 a) {
  return nsvcd__v3_fma(a.z, m.z, nsvcd__v3_fma(a.y, m.y, nsvcd__v3_scale(m.x, a.x)));
}
// One rotation and position for all lanes.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_transform(const nsvcd__transform *t, nsvcd__v3 a) {
  const nsvcd__mat3 columns = nsvcd__mat3_transpose(t->rotation);
  nsvcd__v3 sum = nsvcd__v3_set(t->position);
  sum = nsvcd__v3_fma(a.z, nsvcd__v3_set(columns.z), sum);
  sum = nsvcd__v3_fma(a.y, nsvcd__v3_set(columns.y), sum);
  return nsvcd__v3_fma(a.x, nsvcd__v3_set(columns.x), sum);
}

// Of quaternions of any length whose square fits a float.
static inline nsvcd__vmat3 nsvcd__vmat3_of(nsvcd__vquat q) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v3 axis = nsvcd__vquat_axis(q);
  const nsvcd__v square = nsvcd__v_add(nsvcd__v_mul(q.w, q.w), nsvcd__v3_dot(axis, axis));
  const nsvcd__v3 s = nsvcd__v3_scale(axis, nsvcd__v_div(nsvcd__v_set(2), square));
  // twice x times each, twice w times each, and the products that are left
  const nsvcd__v3 x = nsvcd__v3_scale(axis, s.x);
  const nsvcd__v3 w = nsvcd__v3_scale(s, q.w);
  const nsvcd__v yy = nsvcd__v_mul(s.y, q.y);
  const nsvcd__v zz = nsvcd__v_mul(s.z, q.z);
  const nsvcd__v yz = nsvcd__v_mul(s.y, q.z);
  return nsvcd__vmat3_rows(
      nsvcd__v3_of(nsvcd__v_sub(one, nsvcd__v_add(yy, zz)), nsvcd__v_sub(x.y, w.z),
                   nsvcd__v_add(x.z, w.y)),
      nsvcd__v3_of(nsvcd__v_add(x.y, w.z), nsvcd__v_sub(one, nsvcd__v_add(x.x, zz)),
                   nsvcd__v_sub(yz, w.x)),
      nsvcd__v3_of(nsvcd__v_sub(x.z, w.y), nsvcd__v_add(yz, w.x),
                   nsvcd__v_sub(one, nsvcd__v_add(x.x, yy))));
}
