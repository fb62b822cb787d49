// In: rows of floats, as a body stores them. Out: one sphere, or one slab, as a value.
#pragma once
#include "points.h"

typedef struct nsvcd__sphere {
  nsvcd__f3 centre;
  float radius;
} nsvcd__sphere;

// Many of them, in arrays that follow each other: x, y, z and radii.
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
// Writes the i-th of spheres in arrays of so many slots.
static inline void nsvcd__sphere_store(nsvcd__sphere sphere, float *first, size_t slots,
                                       size_t i) {
  nsvcd__f3_put(sphere.centre, first + i, slots);
  first[3 * slots + i] = sphere.radius;
}

// ---- extremes

// points of a patch's surface that reach about as far as all of it does: surface/sorted
#define NSVCD__EXTREMES 8

// ---- slabs

// Points x about a centre have low <= normal.x <= high, and are no farther than `across` from the
// line along the normal, which is no longer than 1.
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
