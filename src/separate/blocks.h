// In: 16 triangles of a patch, and a plane or other triangles. Out: which of them may meet.
#pragma once
#include "hulls.h"

#ifndef NSVCD_NO_PROOF
// Point i of a patch.
static nsvcd__f3 nsvcd__point_of(const nsvcd__geometry *f, size_t patch,
                                 nsvcd__patch_points points, size_t i) {
  if (i >= points.stored) return nsvcd__f3_load(nsvcd__position_of(f, patch, points, i));
  const nsvcd__vertices stored = nsvcd__vertices_of(f, patch);
  const nsvcd__f3 centre = nsvcd__patch_centre(f, patch);
  const float step = f->steps[patch];
  return nsvcd__f3_of(centre.x + step * (float)stored.x[i],
                      centre.y + step * (float)stored.y[i],
                      centre.z + step * (float)stored.z[i]);
}

// All points of a patch that has few. Corners name them in no order, and which kind each one is
// would be mispredicted.
#define NSVCD__FEW_POINTS 48
static void nsvcd__few_points(const nsvcd__geometry *f, size_t patch,
                              nsvcd__patch_points points, float (*out)[NSVCD__FEW_POINTS]) {
  for (size_t i = 0; i < points.all; i++) {
    const nsvcd__f3 point = nsvcd__point_of(f, patch, points, i);
    out[0][i] = point.x;
    out[1][i] = point.y;
    out[2][i] = point.z;
  }
}

// Loads entries first .. first + count - 1 of a patch, at most 16; the last one is repeated. Stored
// points are off by no more than a quantization error, and what NSVCD__ROUNDING allows.
static void nsvcd__block_load(const nsvcd__geometry *f, size_t patch, size_t first,
                              size_t count, nsvcd__block *out) {
  const nsvcd__patch_points points = nsvcd__points_of(f, patch);
  const size_t bytes = nsvcd__corner_bytes(points.all);
  const unsigned char *codes =
      f->entries + f->first_byte[patch] + 3 * bytes * (first - f->first_triangle[patch]);
  out->patch = patch;
  out->first = first;
  out->count = count;
  const int has_table = points.all <= NSVCD__FEW_POINTS;
  float table[3][NSVCD__FEW_POINTS];
  if (has_table) nsvcd__few_points(f, patch, points, table);
  for (size_t k = 0; k < 3; k++) {
    float(*to)[NSVCD__LANES] = out->corners[k];
    for (size_t l = 0; l < count && has_table; l++) {
      const size_t i = codes[3 * l + k];
      for (size_t axis = 0; axis < 3; axis++) to[axis][l] = table[axis][i];
    }
    for (size_t l = has_table ? count : 0; l < count; l++) {
      const size_t n = 3 * l + k;
      uint16_t i = codes[n];
      if (bytes == 2) memcpy(&i, codes + 2 * n, sizeof i);
      nsvcd__lane_set(nsvcd__point_of(f, patch, points, i), to, l);
    }
    for (size_t l = count; l < NSVCD__LANES; l++)
      nsvcd__lane_set(nsvcd__lane_of(to, count - 1), to, l);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 a = nsvcd__v3_load(out->corners[0], l);
    const nsvcd__v3 b = nsvcd__v3_load(out->corners[1], l);
    const nsvcd__v3 c = nsvcd__v3_load(out->corners[2], l);
    nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_min(a, b), c));
    nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_max(a, b), c));
  }
}

// Poses the corners of the moving block at both ends of an interval, and replaces its boxes by
// those of the posed corners. Without an interval, NULL: at the pose `at` alone.
static NSVCD__NOINLINE void nsvcd__block_pose(nsvcd__blocks *b, const nsvcd__transform *at,
                                              const nsvcd__interval *over) {
  b->over = over;
  b->corner_count = over ? 6 : 3;
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3 low = nsvcd__v3_set(nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF));
    nsvcd__v3 high = nsvcd__v3_negate(low);
    for (size_t k = 0; k < b->corner_count; k++) {
      const nsvcd__v3 own = nsvcd__v3_load(b->moving.corners[k % 3], l);
      const nsvcd__transform *pose = !over ? at : k < 3 ? &over->start : &over->end;
      const nsvcd__v3 corner = nsvcd__v3_transform(pose, own);
      nsvcd__v3_store(b->corners[k], l, corner);
      low = nsvcd__v3_min(low, corner);
      high = nsvcd__v3_max(high, corner);
    }
    nsvcd__v3_store(b->moving.low, l, low);
    nsvcd__v3_store(b->moving.high, l, high);
  }
}

// Of the moving block's corners. axis: unit, as the body has it.
static nsvcd__arm nsvcd__block_arm(nsvcd__block *block, nsvcd__f3 axis, float error) {
  nsvcd__v farthest = nsvcd__v_set(0);  // squares
  nsvcd__v aside = farthest;
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 corner = nsvcd__v3_load(block->corners[k], l);
      const nsvcd__v3 across = nsvcd__v3_cross(corner, nsvcd__v3_set(axis));
      farthest = nsvcd__v_max(farthest, nsvcd__v3_dot(corner, corner));
      aside = nsvcd__v_max(aside, nsvcd__v3_dot(across, across));
    }
  }
  const float from_origin = 1.00001f * sqrtf(nsvcd__greatest_of(0, farthest)) + error;
  const float from_axis = 1.00001f * sqrtf(nsvcd__greatest_of(0, aside)) + error;
  const nsvcd__arm out = {from_origin, from_axis + 1e-6f * from_origin};
  return out;
}

// The box about a block's boxes.
static nsvcd__box nsvcd__block_bounds(const nsvcd__block *block) {
  float low[3], high[3];
  for (size_t k = 0; k < 3; k++) {
    low[k] = HUGE_VALF;
    high[k] = -HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      low[k] = nsvcd__least_of(low[k], nsvcd__v_load(block->low[k] + l));
      high[k] = nsvcd__greatest_of(high[k], nsvcd__v_load(block->high[k] + l));
    }
  }
  const nsvcd__box out = {nsvcd__f3_load(low), nsvcd__f3_load(high)};
  return out;
}

// Loads up to NSVCD__WINDOW blocks of fixed patch j, from entry `first` on, and the boxes about
// them. The same patch is often asked for again.
static void nsvcd__window_load(nsvcd__blocks *b, const nsvcd__geometry *f, size_t j,
                               size_t first) {
  const size_t end = f->first_triangle[j + 1];
  if (b->window > 0 && b->fixed[0].first == first) return;
  b->window = 0;
  for (size_t n = first; n < end && b->window < NSVCD__WINDOW; n += NSVCD__LANES) {
    nsvcd__block *block = &b->fixed[b->window];
    nsvcd__block_load(f, j, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
    b->bounds[b->window++] = nsvcd__block_bounds(block);
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

// Normals of planes that may separate two triangles: the one that separated a triangle pair last;
// those of both; and of an edge of each.
#define NSVCD__LAST_NORMAL 0
#define NSVCD__NORMALS 12

// Normal k, of any length, for lane l of the moving block and a slice, from s on, of a fixed one. A
// moving edge without length, of a point or a segment: its corner's travel counts instead.
NSVCD__INLINE nsvcd__v3 nsvcd__normal_to_try(nsvcd__solver *w, size_t l, nsvcd__block *fixed,
                                             size_t s, size_t k) {
  if (k == NSVCD__LAST_NORMAL) return nsvcd__v3_set(nsvcd__f3_round(w->p.separating));
  if (k == 1) {
    const nsvcd__v3 b = nsvcd__v3_load(fixed->corners[0], s);
    const nsvcd__v3 u = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[1], s), b);
    const nsvcd__v3 v = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[2], s), b);
    return nsvcd__v3_cross(u, v);
  }
  if (k == 2) {
    const nsvcd__f3 a = nsvcd__lane_of(w->blocks.corners[0], l);
    const nsvcd__f3 u = nsvcd__f3_sub(nsvcd__lane_of(w->blocks.corners[1], l), a);
    const nsvcd__f3 v = nsvcd__f3_sub(nsvcd__lane_of(w->blocks.corners[2], l), a);
    return nsvcd__v3_set(nsvcd__f3_cross(u, v));
  }
  const size_t of_moving = k / 3 - 1;
  const size_t of_fixed = k % 3;
  const nsvcd__v3 b = nsvcd__v3_load(fixed->corners[of_fixed], s);
  const nsvcd__v3 b_next = nsvcd__v3_load(fixed->corners[(of_fixed + 1) % 3], s);
  const nsvcd__f3 a = nsvcd__lane_of(w->blocks.corners[of_moving], l);
  const nsvcd__f3 a_next = nsvcd__lane_of(w->blocks.corners[(of_moving + 1) % 3], l);
  nsvcd__f3 edge = nsvcd__f3_sub(a_next, a);
  if (w->blocks.over && !(nsvcd__f3_dot(edge, edge) > 0))
    edge = nsvcd__f3_sub(nsvcd__lane_of(w->blocks.corners[3 + of_moving], l), a);
  return nsvcd__v3_cross(nsvcd__v3_set(edge), nsvcd__v3_sub(b_next, b));
}

// Lanes of a slice, from s on, of a fixed block that planes with these normals, of any length,
// separate from lane l of the moving one, as posed, by more than `margin`.
NSVCD__INLINE uint32_t nsvcd__normals_separate(nsvcd__blocks *b, size_t l, nsvcd__block *fixed,
                                               size_t s, float margin, nsvcd__v3 n) {
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
  for (size_t k = 0; k < b->corner_count; k++) {
    const nsvcd__v3 a = nsvcd__v3_set(nsvcd__lane_of(b->corners[k], l));
    const nsvcd__v height = nsvcd__v3_dot(n, nsvcd__v3_sub(a, b0));
    lowest = nsvcd__v_min(lowest, height);
    highest = nsvcd__v_max(highest, height);
  }
  // where the normal's square underflows, nothing is beyond the limit
  const nsvcd__v square = nsvcd__v3_dot(n, n);
  nsvcd__v limit = nsvcd__v_scale(nsvcd__v_sqrt(square), margin);
  limit = nsvcd__v_pick(square, nsvcd__v_set(1e-30f), nsvcd__v_set(1e30f), limit);
  const uint32_t below = nsvcd__v_lt(highest, nsvcd__v_sub(low, limit));
  return nsvcd__v_lt(nsvcd__v_add(high, limit), lowest) | below;
}

// Of these lanes of a fixed block, those that planes with normal k do not separate from lane l of
// the moving one by more than `margin`.
NSVCD__INLINE uint32_t nsvcd__left_by_normal(nsvcd__solver *w, size_t l, nsvcd__block *fixed,
                                             size_t k, float margin, uint32_t met) {
  NSVCD__EACH_SLICE(s) {
    if (!(met >> s & NSVCD__SLICE_MASK)) continue;
    const nsvcd__v3 normal = nsvcd__normal_to_try(w, l, fixed, s, k);
    met &= ~(nsvcd__normals_separate(&w->blocks, l, fixed, s, margin, normal) << s);
  }
  return met;
}

// Of these lanes of the moving block, those that the plane which separated a triangle pair last
// does not separate from all of a fixed block by more than `margin`. Tried where there is a
// clearance: then near triangles have their nearest points along nearly the same direction.
static NSVCD__NOINLINE uint32_t nsvcd__lanes_left_by_last(nsvcd__solver *w,
                                                          nsvcd__block *fixed, float margin,
                                                          uint32_t lanes) {
  nsvcd__proof *p = &w->p;
  const nsvcd__f3 last = nsvcd__f3_round(p->separating);
  const nsvcd__v3 normal = nsvcd__v3_set(last);
  if (!(p->goal.clearance > 0) || !lanes) return lanes;
  float highest = -HUGE_VALF;  // of the fixed block
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(s) {
      const nsvcd__v3 corner = nsvcd__v3_load(fixed->corners[k], s);
      highest = nsvcd__greatest_of(highest, nsvcd__v3_dot(normal, corner));
    }
  }
  const nsvcd__v limit = nsvcd__v_set(margin * nsvcd__f3_norm(last) + highest);
  uint32_t apart = 0;
  NSVCD__EACH_SLICE(s) {
    nsvcd__v height = nsvcd__v_set(HUGE_VALF);
    for (size_t k = 0; k < w->blocks.corner_count; k++) {
      const nsvcd__v3 corner = nsvcd__v3_load(w->blocks.corners[k], s);
      height = nsvcd__v_min(height, nsvcd__v3_dot(normal, corner));
    }
    apart |= nsvcd__v_lt(limit, height) << s;
  }
  return lanes & ~apart;
}

// Lanes of a fixed block that neither boxes nor planes separate from lane l of the moving one.
static NSVCD__NOINLINE uint32_t nsvcd__row_left(nsvcd__solver *w, size_t l,
                                                nsvcd__block *fixed, float margin) {
  nsvcd__block *block = &w->blocks.moving;
  const nsvcd__box box = {nsvcd__lane_of(block->low, l), nsvcd__lane_of(block->high, l)};
  uint32_t met = nsvcd__lanes_near(fixed, box, margin);
  // of a segment (a, b, b) or a point the normals of all edges but one, or two, are those of others
  const nsvcd__f3 a = nsvcd__lane_of(block->corners[0], l);
  const nsvcd__f3 b = nsvcd__lane_of(block->corners[1], l);
  const nsvcd__f3 c = nsvcd__lane_of(block->corners[2], l);
  const nsvcd__f3 ab = nsvcd__f3_sub(b, a);
  const nsvcd__f3 bc = nsvcd__f3_sub(c, b);
  const int is_segment = !(nsvcd__f3_dot(bc, bc) > 0);
  const int is_point = is_segment && !(nsvcd__f3_dot(ab, ab) > 0);
  const size_t normals = is_point ? 6 : is_segment ? 9 : NSVCD__NORMALS;
  // the last plane: see nsvcd__lanes_left_by_last
  for (size_t k = w->p.goal.clearance > 0 ? NSVCD__LAST_NORMAL : 1; met && k < normals;
       k += k == 1 && is_segment ? 2 : 1)
    met = nsvcd__left_by_normal(w, l, fixed, k, margin, met);
  return met;
}
#endif  // NSVCD_NO_PROOF
