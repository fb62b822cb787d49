// In: 16 triangles of a patch, and a plane or other triangles. Out: which of them may meet.
#pragma once
#include "hulls.h"

#ifndef NSVCD_NO_PROOF
// Corner k of entries first .. first + count - 1, as vertices of their patch: what
// nsvcd__triangle_corner says of each, the patch asked once.
static void nsvcd__block_corners(const nsvcd__geometry *f, size_t patch, size_t first,
                                 size_t count, size_t k, uint16_t *vertices) {
  const size_t bytes = nsvcd__corner_bytes(nsvcd__points_of(f, patch).all);
  const size_t at = 3 * (first - f->first_triangle[patch]) + k;
  const unsigned char *corners = f->entries + f->first_byte[patch] + bytes * at;
  for (size_t l = 0; l < count; l++) {
    if (bytes == 1)
      vertices[l] = corners[3 * l];
    else
      memcpy(vertices + l, corners + 6 * l, 2);
  }
}

// Listings first .. first + count - 1 of a patch, at most 16; the last is repeated. Stored points
// are off by no more than a quantization error, and what NSVCD__ROUNDING allows.
static void nsvcd__block_load(const nsvcd__geometry *f, size_t patch, size_t first,
                              size_t count, nsvcd__block *out) {
  const nsvcd__patch_points points = nsvcd__points_of(f, patch);
  const nsvcd__vertices stored = nsvcd__vertices_of(f, patch);
  const nsvcd__f3 centre = nsvcd__patch_centre(f, patch);
  const float step = f->steps[patch];
  out->first = first;
  out->count = count;
  for (size_t k = 0; k < 3; k++) {
    uint16_t corners[NSVCD__LANES];
    float(*to)[NSVCD__LANES] = out->corners[k];
    nsvcd__block_corners(f, patch, first, count, k, corners);
    for (size_t l = 0; l < count; l++) {
      const size_t i = corners[l];
      if (i < points.stored) {
        to[0][l] = centre.x + step * (float)stored.x[i];
        to[1][l] = centre.y + step * (float)stored.y[i];
        to[2][l] = centre.z + step * (float)stored.z[i];
        continue;
      }
      const float *position = nsvcd__position_of(f, patch, points, i);
      to[0][l] = position[0];
      to[1][l] = position[1];
      to[2][l] = position[2];
    }
    for (size_t l = count; l < NSVCD__LANES; l++)
      for (size_t axis = 0; axis < 3; axis++) to[axis][l] = to[axis][count - 1];
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 a = nsvcd__v3_load(out->corners[0], l);
    const nsvcd__v3 b = nsvcd__v3_load(out->corners[1], l);
    const nsvcd__v3 c = nsvcd__v3_load(out->corners[2], l);
    nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_min(a, b), c));
    nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_max(a, b), c));
  }
}

// Poses the corners of the moving block, into p->posed[which].
static NSVCD__NOINLINE void nsvcd__block_pose(nsvcd__proof *p, const nsvcd__transform *at,
                                              size_t which) {
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->moving_block.corners[k], l);
      nsvcd__v3_store(p->posed[which][k], l, nsvcd__v3_transform(at, corner));
    }
  }
}

// Of the moving block's corners. axis: unit, as the body has it.
static nsvcd__arm nsvcd__block_arm(nsvcd__proof *p, nsvcd__f3 axis, float quantization_error) {
  nsvcd__v farthest2 = nsvcd__v_set(0);
  nsvcd__v aside = farthest2;
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->moving_block.corners[k], l);
      const nsvcd__v3 across = nsvcd__v3_cross(corner, nsvcd__v3_set(axis));
      farthest2 = nsvcd__v_max(farthest2, nsvcd__v3_dot(corner, corner));
      aside = nsvcd__v_max(aside, nsvcd__v3_dot(across, across));
    }
  }
  const float from_origin =
      1.00001f * sqrtf(-nsvcd__v_least(nsvcd__v_negate(farthest2))) + quantization_error;
  const float from_axis =
      1.00001f * sqrtf(-nsvcd__v_least(nsvcd__v_negate(aside))) + quantization_error;
  const nsvcd__arm out = {from_origin, from_axis + 1e-6f * from_origin};
  return out;
}

// Replaces the boxes of the moving block by those of its posed corners, at `ends` (1 or 2) poses.
static void nsvcd__block_box(nsvcd__proof *p, size_t ends) {
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3 low = nsvcd__v3_load(p->posed[0][0], l);
    nsvcd__v3 high = low;
    for (size_t n = 1; n < 3 * ends; n++) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->posed[n / 3][n % 3], l);
      low = nsvcd__v3_min(low, corner);
      high = nsvcd__v3_max(high, corner);
    }
    nsvcd__v3_store(p->moving_block.low, l, low);
    nsvcd__v3_store(p->moving_block.high, l, high);
  }
}

// The box about a block's boxes.
static nsvcd__box nsvcd__block_bounds(const nsvcd__block *block) {
  float low[3], high[3];
  for (size_t k = 0; k < 3; k++) {
    float least = HUGE_VALF;
    float negated = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v above = nsvcd__v_negate(nsvcd__v_load(block->high[k] + l));
      least = nsvcd__least_of(least, nsvcd__v_least(nsvcd__v_load(block->low[k] + l)));
      negated = nsvcd__least_of(negated, nsvcd__v_least(above));
    }
    low[k] = least;
    high[k] = -negated;
  }
  const nsvcd__box out = {nsvcd__f3_load(low), nsvcd__f3_load(high)};
  return out;
}

// Loads up to NSVCD__WINDOW blocks of resting patch j, from entry `first` on, and what they
// extend to. The same patch is often asked for again.
static void nsvcd__window_load(nsvcd__proof *p, size_t j, size_t first) {
  const size_t end = p->fixed.first_triangle[j + 1];
  if (p->memo.window > 0 && p->fixed_blocks[0].first == first) return;
  p->memo.window = 0;
  for (size_t n = first; n < end && p->memo.window < NSVCD__WINDOW; n += NSVCD__LANES) {
    nsvcd__block *block = &p->fixed_blocks[p->memo.window];
    nsvcd__block_load(&p->fixed, j, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
    p->bounds[p->memo.window] = nsvcd__block_bounds(block);
    p->memo.window++;
  }
}

// The lanes of a block that are entries of their own.
static inline uint32_t nsvcd__block_lanes(const nsvcd__block *block) {
  return ((uint32_t)1 << (block->count - 1) << 1) - 1;
}

// Lanes of a block whose boxes come within `margin` of a box along every axis.
NSVCD__INLINE uint32_t nsvcd__lanes_near(const nsvcd__block *block, nsvcd__box box,
                                         float margin) {
  const nsvcd__f3 around = nsvcd__f3_of(margin, margin, margin);
  float low[3], high[3];
  nsvcd__f3_store(nsvcd__f3_sub(box.low, around), low);
  nsvcd__f3_store(nsvcd__f3_add(box.high, around), high);
  uint32_t lanes = 0;
  NSVCD__EACH_SLICE(l) {
    uint32_t slice = NSVCD__SLICE_MASK;
    for (size_t k = 0; k < 3; k++) {
      slice &= nsvcd__v_le(nsvcd__v_load(block->low[k] + l), nsvcd__v_set(high[k]));
      slice &= nsvcd__v_le(nsvcd__v_set(low[k]), nsvcd__v_load(block->high[k] + l));
    }
    lanes |= slice << l;
  }
  return lanes & nsvcd__block_lanes(block);
}

static nsvcd__box nsvcd__box_of_lane(nsvcd__block *block, size_t l) {
  const nsvcd__box out = {nsvcd__lane_of(block->low, l), nsvcd__lane_of(block->high, l)};
  return out;
}

// A margin along normals of any length. Where their squares underflow it is so large that nothing
// is beyond it.
static nsvcd__v nsvcd__margin_along(nsvcd__v3 n, float margin) {
  const nsvcd__v square = nsvcd__v3_dot(n, n);
  const nsvcd__v limit = nsvcd__v_scale(nsvcd__v_sqrt(square), margin);
  return nsvcd__v_pick(square, nsvcd__v_set(1e-30f), nsvcd__v_set(1e30f), limit);
}

// Lanes of a slice, from s on, of a fixed block that planes with these normals, of any length, have
// on one side of lane l of the moving one, at `ends` (1 or 2) poses, by more than `margin`. below:
// the moving one is on the side that the normal points from.
NSVCD__INLINE uint32_t nsvcd__normals_separate(nsvcd__proof *p, size_t l, nsvcd__block *fixed,
                                               size_t s, size_t ends, float margin,
                                               nsvcd__v3 n, uint32_t *below) {
  const nsvcd__v3 b0 = nsvcd__v3_load(fixed->corners[0], s);
  const nsvcd__v3 edge1 = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[1], s), b0);
  const nsvcd__v3 edge2 = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[2], s), b0);
  const nsvcd__v height1 = nsvcd__v3_dot(n, edge1);
  const nsvcd__v height2 = nsvcd__v3_dot(n, edge2);
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v low = nsvcd__v_min(zero, nsvcd__v_min(height1, height2));
  const nsvcd__v high = nsvcd__v_max(zero, nsvcd__v_max(height1, height2));
  nsvcd__v lowest = nsvcd__v_set(HUGE_VALF);
  nsvcd__v highest = nsvcd__v_set(-HUGE_VALF);
  for (size_t k = 0; k < 3 * ends; k++) {
    const nsvcd__v3 a = nsvcd__v3_set(nsvcd__lane_of(p->posed[k / 3][k % 3], l));
    const nsvcd__v height = nsvcd__v3_dot(n, nsvcd__v3_sub(a, b0));
    lowest = nsvcd__v_min(lowest, height);
    highest = nsvcd__v_max(highest, height);
  }
  const nsvcd__v limit = nsvcd__margin_along(n, margin);
  *below = nsvcd__v_lt(highest, nsvcd__v_sub(low, limit));
  return nsvcd__v_lt(nsvcd__v_add(high, limit), lowest) | *below;
}

// Normal number k of those that may part two triangles at `ends` (1 or 2) poses: of the fixed ones
// in a slice, of lane l of the moving one, and of an edge of each; of an edge without length, which
// points and segments have, it is that corner's way that counts.
#define NSVCD__NORMALS 11
NSVCD__INLINE nsvcd__v3 nsvcd__normal_to_try(nsvcd__proof *p, size_t l, nsvcd__block *fixed,
                                             size_t s, size_t ends, size_t k) {
  if (k == 1) {
    const nsvcd__f3 a = nsvcd__lane_of(p->posed[0][0], l);
    const nsvcd__f3 u = nsvcd__f3_sub(nsvcd__lane_of(p->posed[0][1], l), a);
    const nsvcd__f3 v = nsvcd__f3_sub(nsvcd__lane_of(p->posed[0][2], l), a);
    return nsvcd__v3_set(nsvcd__f3_cross(u, v));
  }
  const size_t fixed_edge = k == 0 ? 0 : (k - 2) % 3;
  const size_t moving_edge = k == 0 ? 0 : (k - 2) / 3;
  const nsvcd__v3 b = nsvcd__v3_load(fixed->corners[fixed_edge], s);
  const nsvcd__v3 next = nsvcd__v3_load(fixed->corners[(fixed_edge + 1) % 3], s);
  const nsvcd__v3 edge = nsvcd__v3_sub(next, b);
  if (k == 0)
    return nsvcd__v3_cross(edge, nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[2], s), b));
  const nsvcd__f3 a = nsvcd__lane_of(p->posed[0][moving_edge], l);
  const nsvcd__f3 after = nsvcd__lane_of(p->posed[0][(moving_edge + 1) % 3], l);
  nsvcd__f3 other = nsvcd__f3_sub(after, a);
  if (ends == 2 && !(nsvcd__f3_dot(other, other) > 0))
    other = nsvcd__f3_sub(nsvcd__lane_of(p->posed[1][moving_edge], l), a);
  return nsvcd__v3_cross(nsvcd__v3_set(other), edge);
}

#ifdef NSVCD__CERTIFIES
// All triangle pairs of lane l and the `apart` lanes of a block, by the planes of their slice, from
// s on, or, where that is NULL, by their boxes.
static void nsvcd__certify_block(nsvcd__proof *p, size_t i, size_t j, size_t l,
                                 const nsvcd__block *b, const nsvcd__interval *interval,
                                 uint32_t apart, size_t s, const nsvcd__v3 *plane,
                                 uint32_t below) {
  float lanes[3][NSVCD__LANES];
  const nsvcd__block *a = &p->moving_block;
  if (plane) nsvcd__v3_store(lanes, s, *plane);
  for (size_t n = 0; n < b->count; n++) {
    float normal[3] = {0, 0, 0};
    float widest = -HUGE_VALF;
    const float sign = below >> n & 1 ? -1.0f : 1.0f;
    if (!(apart >> n & 1)) continue;
    for (size_t k = 0; k < 3; k++) {
      if (plane) normal[k] = sign * lanes[k][n];
      const float above = a->low[k][l] - b->high[k][n];
      const float under = b->low[k][n] - a->high[k][l];
      if (plane || (above <= widest && under <= widest)) continue;
      widest = above > under ? above : under;
      normal[0] = normal[1] = normal[2] = 0;
      normal[k] = above > under ? 1.0f : -1.0f;
    }
    NSVCD__CERTIFY(NSVCD__BY_TRIANGLES, i, j, a->first + l, b->first + n, interval->t_start,
                   interval->t_end, normal);
  }
}
#define NSVCD__CERTIFY_BLOCK(p, i, j, l, b, interval, apart, s, plane, below) \
  nsvcd__certify_block(p, i, j, l, b, interval, apart, s, plane, below)
#else
#define NSVCD__CERTIFY_BLOCK(p, i, j, l, b, interval, apart, s, plane, below) ((void)0)
#endif

// Of these lanes of a fixed block, those that the plane which separated a triangle pair last does
// not separate from lane l of the moving one as well, by more than `margin`, at `ends` poses. Where
// there is a clearance it parts many: triangles near by have their nearest points along nearly the
// same direction.
static NSVCD__NOINLINE uint32_t nsvcd__left_by_last(nsvcd__proof *p, size_t i, size_t j,
                                                    size_t l, nsvcd__block *fixed, size_t ends,
                                                    const nsvcd__interval *interval,
                                                    float margin, uint32_t met) {
  const nsvcd__v3 normal = nsvcd__v3_set(nsvcd__f3_round(p->memo.separating));
  NSVCD__EACH_SLICE(s) {
    uint32_t below;
    if (!(met >> s & NSVCD__SLICE_MASK)) continue;
    const uint32_t apart =
        nsvcd__normals_separate(p, l, fixed, s, ends, margin, normal, &below) << s & met;
    if (interval)
      NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, interval, apart, s, &normal, below << s);
    met &= ~apart;
  }
  (void)i;
  (void)j;
  return met;
}

// Of these lanes of the moving block, those that the plane which separated a triangle pair last
// does not separate from all of a fixed block, by more than `margin`, at `ends` poses.
static NSVCD__NOINLINE uint32_t nsvcd__lanes_left_by_last(nsvcd__proof *p, size_t i, size_t j,
                                                          nsvcd__block *fixed, size_t ends,
                                                          const nsvcd__interval *interval,
                                                          float margin, uint32_t lanes) {
  const nsvcd__f3 last = nsvcd__f3_round(p->memo.separating);
  const nsvcd__v3 normal = nsvcd__v3_set(last);
  if (!(p->ask.clearance > 0) || !lanes) return lanes;
  float lowest = HUGE_VALF;  // of the fixed block's heights, negated
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(s) {
      const nsvcd__v height = nsvcd__v3_dot(normal, nsvcd__v3_load(fixed->corners[k], s));
      lowest = nsvcd__least_of(lowest, nsvcd__v_least(nsvcd__v_negate(height)));
    }
  }
  const nsvcd__v limit = nsvcd__v_set(margin * nsvcd__f3_length(last) - lowest);
  uint32_t apart = 0;
  NSVCD__EACH_SLICE(s) {
    nsvcd__v height = nsvcd__v3_dot(normal, nsvcd__v3_load(p->posed[0][0], s));
    for (size_t k = 1; k < 3 * ends; k++) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->posed[k / 3][k % 3], s);
      height = nsvcd__v_min(height, nsvcd__v3_dot(normal, corner));
    }
    apart |= nsvcd__v_lt(limit, height) << s;
  }
  apart &= lanes;
  for (uint32_t told = interval ? apart : 0; told; told &= told - 1) {
    NSVCD__EACH_SLICE(s)
    NSVCD__CERTIFY_BLOCK(p, i, j, nsvcd__low_bit(told), fixed, interval,
                         NSVCD__SLICE_MASK << s, s, &normal, 0);
  }
  (void)i;
  (void)j;
  return lanes & ~apart;
}

// Lanes of a fixed block that neither boxes nor planes separate from lane l of the moving one, at
// `ends` poses. interval: of patches i and j, for the certificates; NULL for none.
static NSVCD__NOINLINE uint32_t nsvcd__row_left(nsvcd__proof *p, size_t i, size_t j, size_t l,
                                                nsvcd__block *fixed, size_t ends,
                                                const nsvcd__interval *interval,
                                                float margin) {
  uint32_t met = nsvcd__lanes_near(fixed, nsvcd__box_of_lane(&p->moving_block, l), margin);
  if (interval) NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, interval, ~met, 0, NULL, 0);
  if (p->ask.clearance > 0)
    met = nsvcd__left_by_last(p, i, j, l, fixed, ends, interval, margin, met);
  for (size_t k = 0; met && k < NSVCD__NORMALS; k++) {
    NSVCD__EACH_SLICE(s) {
      uint32_t below;
      if (!(met >> s & NSVCD__SLICE_MASK)) continue;
      const nsvcd__v3 normal = nsvcd__normal_to_try(p, l, fixed, s, ends, k);
      const uint32_t apart =
          nsvcd__normals_separate(p, l, fixed, s, ends, margin, normal, &below) << s & met;
      if (interval)
        NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, interval, apart, s, &normal, below << s);
      met &= ~apart;
    }
  }
  (void)i;
  (void)j;
  return met;
}
#endif  // NSVCD_NO_PROOF
