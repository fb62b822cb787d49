// In: rows of floats, as a body stores them. Out: a sphere or a slab as a value, and constants of
// what is stored of a patch.
#pragma once
#include "points.h"

// The radius of padding: meets nothing, and its square is finite. A float to the last digit, for
// blobs are compared with it, also where constants are computed in double (FLT_EVAL_METHOD).
#define NSVCD__NOWHERE (-999999986991104.0f)

typedef struct nsvcd__sphere {
  nsvcd__f3 centre;
  float radius;
} nsvcd__sphere;

// Many, in arrays of x, y, z and radii.
typedef struct nsvcd__spheres {
  const float *x, *y, *z, *r;
} nsvcd__spheres;

static inline nsvcd__spheres nsvcd__spheres_of(const float *first, size_t slots) {
  const nsvcd__spheres out = {first, first + slots, first + 2 * slots, first + 3 * slots};
  return out;
}
static inline nsvcd__spheres nsvcd__spheres_from(nsvcd__spheres all, size_t i) {
  const nsvcd__spheres out = {all.x + i, all.y + i, all.z + i, all.r + i};
  return out;
}
static inline nsvcd__f3 nsvcd__centre_of(nsvcd__spheres all, size_t i) {
  return nsvcd__f3_of(all.x[i], all.y[i], all.z[i]);
}
static inline nsvcd__sphere nsvcd__sphere_of(nsvcd__spheres all, size_t i) {
  const nsvcd__sphere out = {nsvcd__centre_of(all, i), all.r[i]};
  return out;
}
// Writes sphere i into arrays of so many slots, one after the other.
static inline void nsvcd__sphere_store(nsvcd__sphere sphere, float *first, size_t slots,
                                       size_t i) {
  nsvcd__f3_put(sphere.centre, first + i, slots);
  first[3 * slots + i] = sphere.radius;
}

// ---- patches

#define NSVCD__EXTREMES 8  // points of the surface that span about all of it: surface/sorted
#define NSVCD__HULL 16     // vertices of the hull, at most

// What a stored triangle belongs to: a sheet; what is nearly a solid; a closed surface, which winds
// about what it contains; or one whose triangles face either way, so that a ray's crossings are
// counted without their sign. In the upper bits, above the triangle's number.
enum { NSVCD__SHEET, NSVCD__NEARLY, NSVCD__CLOSED, NSVCD__EITHER_DIRECTION };
#define NSVCD__KIND_SHIFT 30
#define NSVCD__NUMBER 0x3fffffffu

// ---- slabs

// Points x about a centre have low <= normal.x <= high, and are no farther than `across` from the
// line along the normal, |normal| <= 1.
typedef struct nsvcd__slab {
  nsvcd__f3 normal;
  float low, high, across;
} nsvcd__slab;

// Slab i of (6, stride).
static inline nsvcd__slab nsvcd__slab_at(const float *slabs, size_t stride, size_t i) {
  const float *d = slabs + i;
  nsvcd__slab out;
  out.normal = nsvcd__f3_get(d, stride);
  out.low = d[3 * stride];
  out.high = d[4 * stride];
  out.across = d[5 * stride];
  return out;
}
static inline void nsvcd__slab_store(nsvcd__slab slab, float *slabs, size_t stride, size_t i) {
  float *d = slabs + i;
  nsvcd__f3_put(slab.normal, d, stride);
  d[3 * stride] = slab.low;
  d[4 * stride] = slab.high;
  d[5 * stride] = slab.across;
}
