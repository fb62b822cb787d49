// In: two bodies that do not touch at a time. Out: is a component of one inside the other? By rays,
// in double.
#pragma once
#include "triangle_pairs.h"
#include "blocks.h"

#ifndef NSVCD_NO_PROOF
// A ray from a place of a body's frame, in that frame: does the body enclose the place?
typedef struct nsvcd__ray {
  nsvcd__d3 from, direction;
  // a ray that passes an edge within this tells nothing; and that, with what rounding may add
  double margin;
  float rounding;
} nsvcd__ray;

// +1 if the ray leaves through the triangle, -1 if it enters, 0 if it misses it; *unclear if it
// passes an edge.
static int nsvcd__ray_crosses(const nsvcd__ray *ray, const nsvcd__d3 *t, double margin,
                              int *unclear) {
  double around[3];
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  double nearest = HUGE_VAL;
  const nsvcd__d3 n = nsvcd__face_normal(t);
  // the signed volumes of the edges and the ray: all alike if it passes within
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    const nsvcd__d3 across = nsvcd__d3_cross(edge, ray->direction);
    const double length = nsvcd__d3_length(across);
    around[k] = nsvcd__d3_dot(across, nsvcd__d3_sub(t[k], ray->from));
    least = nsvcd__min(least, around[k]);
    most = nsvcd__max(most, around[k]);
    nearest = nsvcd__min(nearest, length > 0 ? fabs(around[k]) / length : 0);
  }
  const double slope = nsvcd__d3_dot(n, ray->direction);
  const double height = nsvcd__d3_dot(n, nsvcd__d3_sub(t[0], ray->from));
  const double size = nsvcd__d3_length(n);
  const int behind = height * slope < 0 && fabs(height) > margin * size;
  if (behind) return 0;
  if (nearest <= margin) {
    // Near the line of an edge, but is it near the triangle?
    nsvcd__d3 far_end = nsvcd__d3_add(ray->from, nsvcd__d3_scale(ray->direction, 4 * 1.6e7));
    nsvcd__nearest near_edge = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < 3; k++)
      nsvcd__edges_nearest(ray->from, far_end, t[k], t[(k + 1) % 3], &near_edge);
    if (near_edge.square <= 4 * margin * margin) *unclear = 1;
    if (least < 0 && most > 0) return 0;
  }
  if (least <= 0 && most >= 0) return 0;
  if (fabs(height) <= margin * size) *unclear = 1;
  return slope > 0 ? 1 : slope < 0 ? -1 : 0;
}

// Is the triangle new to the list of those that a ray has crossed? Then it is added; *unclear if
// there is no room.
static int nsvcd__is_new(nsvcd__proof *p, size_t *count, uint32_t number, int *unclear) {
  for (size_t k = 0; k < *count; k++) {
    if (p->crossed[k] == number) return 0;
  }
  if (*count == NSVCD__CROSSED) *unclear = 1;
  if (*count < NSVCD__CROSSED) p->crossed[(*count)++] = number;
  return 1;
}

// Lanes of a block whose triangles the ray crosses, or passes within the margin, and some more. The
// signed volumes of the edges and the ray are products of an edge and a place on it, off by no more
// than `rounding`, square metres: see nsvcd__crossings.
static uint32_t nsvcd__lanes_on_ray(nsvcd__block *block, const nsvcd__ray *ray, float margin,
                                    float rounding) {
  const nsvcd__f3 start = nsvcd__f3_round(ray->from);
  const nsvcd__f3 heading = nsvcd__f3_round(ray->direction);
  uint32_t missed = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 from = nsvcd__v3_set(start);
    const nsvcd__v3 direction = nsvcd__v3_set(heading);
    const nsvcd__v3 a = nsvcd__v3_load(block->corners[0], l);
    const nsvcd__v3 b = nsvcd__v3_load(block->corners[1], l);
    const nsvcd__v3 c = nsvcd__v3_load(block->corners[2], l);
    const nsvcd__v3 ab = nsvcd__v3_cross(nsvcd__v3_sub(b, a), direction);
    const nsvcd__v3 bc = nsvcd__v3_cross(nsvcd__v3_sub(c, b), direction);
    const nsvcd__v3 ca = nsvcd__v3_cross(nsvcd__v3_sub(a, c), direction);
    const nsvcd__v by_ab = nsvcd__v3_dot(ab, nsvcd__v3_sub(a, from));
    const nsvcd__v by_bc = nsvcd__v3_dot(bc, nsvcd__v3_sub(b, from));
    const nsvcd__v by_ca = nsvcd__v3_dot(ca, nsvcd__v3_sub(c, from));
    const nsvcd__v least = nsvcd__v_min(by_ab, nsvcd__v_min(by_bc, by_ca));
    const nsvcd__v most = nsvcd__v_max(by_ab, nsvcd__v_max(by_bc, by_ca));
    const nsvcd__v longer = nsvcd__v_max(nsvcd__v3_length(bc), nsvcd__v3_length(ca));
    const nsvcd__v longest = nsvcd__v_max(nsvcd__v3_length(ab), longer);
    const nsvcd__v allowed =
        nsvcd__v_fma(nsvcd__v_set(margin), longest, nsvcd__v_set(rounding));
    missed |= (nsvcd__v_lt(least, nsvcd__v_negate(allowed)) & nsvcd__v_lt(allowed, most)) << l;
  }
  return nsvcd__block_lanes(block) & ~missed;
}

// What a ray crosses: how often the closed surfaces wind about its place; and of those whose
// winding does not tell, and of what is nearly a solid, how many triangles. *unclear if it cannot
// tell.
typedef struct nsvcd__crossings {
  int winds, either_way, nearly, unclear;
} nsvcd__crossings;

// Of one ray. A triangle counts once, whatever patches list it, or parts of it. No ray counts that
// comes as near to an edge as gaps are wide that were closed: so it passes through none.
//
// How far are the signed volumes of nsvcd__lanes_on_ray off? With u = 2^-24, E the extent, R that
// and the distance of the ray's place: a corner, a vertex of up to E from a centre of up to E, is
// off by 2 u E. An edge, of up to 2 E, by two corners and its own rounding, 6 u E; its product with
// the direction, rounded as well, by 6 + 2 + 2.31 x 2 (|a_y b_z| + |a_z b_y| and so on are no more
// than 1.155 |a| |b| together) = 12.7 u E. A place on it, up to R from the ray's, by 3 u R. The
// volume then by 12.7 u E R + 2 E x 3 u R, and by 3 roundings of up to 2 E R: 24.7 u E R, less than
// 1.5e-6 E R. NSVCD__ROUNDING is more.
static nsvcd__crossings nsvcd__cross_all(nsvcd__proof *p, const nsvcd__geometry *f,
                                         const nsvcd__ray *ray) {
  nsvcd__block *block = &p->fixed_blocks[0];
  p->memo.window = 0;
  const float extent = (float)nsvcd__d3_length(ray->from) + f->body->extent;
  const float rounding = NSVCD__ROUNDING * extent * f->body->extent;
  nsvcd__crossings sum = {0, 0, 0, 0};
  size_t count = 0;
  size_t g;
  const nsvcd__beam beam = {nsvcd__f3_round(ray->from), nsvcd__f3_round(ray->direction),
                            ray->rounding};
  nsvcd__traversal traversal;
  nsvcd__traversal_begin(&traversal, f->body, nsvcd__is_on_beam, &beam);
  while (!sum.unclear && nsvcd__traversal_next(&traversal, &g)) {
    const nsvcd__spheres all = nsvcd__body_patches(f->body);
    uint32_t patches = nsvcd__is_on_beam(&beam, nsvcd__spheres_from(all, NSVCD__GROUP * g));
    for (; patches && !sum.unclear; patches &= patches - 1) {
      const size_t i = NSVCD__GROUP * g + nsvcd__low_bit(patches);
      if (i >= f->body->patches) break;
      const float about = 2 * (f->errors[i] + (float)ray->margin);
      const size_t end = f->first_triangle[i + 1];
      nsvcd__numbers numbers = nsvcd__numbers_of(f, i);
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        p->work++;
        uint32_t lanes = nsvcd__lanes_on_ray(block, ray, about, rounding);
        for (; lanes; lanes &= lanes - 1) {
          const size_t entry = n + nsvcd__low_bit(lanes);
          nsvcd__d3 corners[3];
          nsvcd__read_number(&numbers, entry);
          if (numbers.kind == NSVCD__SHEET) continue;
          p->work++;
          nsvcd__patch_triangle(f, i, entry, corners);
          const int crossing = nsvcd__ray_crosses(ray, corners, ray->margin, &sum.unclear);
          if (!crossing || !nsvcd__is_new(p, &count, numbers.number, &sum.unclear)) continue;
          if (numbers.kind == NSVCD__CLOSED) sum.winds += crossing;
          sum.either_way += numbers.kind == NSVCD__EITHER_DIRECTION;
          sum.nearly += numbers.kind == NSVCD__NEARLY;
        }
      }
    }
  }
  return sum;
}

// A place in a body's frame, and a distance from it.
typedef struct nsvcd__surroundings {
  nsvcd__f3 position;
  float distance;
} nsvcd__surroundings;

// Lanes of 16 spheres that come within that; a filter of a traversal.
static uint32_t nsvcd__is_around(const void *what, nsvcd__spheres all) {
  const nsvcd__surroundings *here = (const nsvcd__surroundings *)what;
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d =
        nsvcd__v3_sub(nsvcd__v3_centres(all, l), nsvcd__v3_set(here->position));
    const nsvcd__v radius = nsvcd__v_plus(nsvcd__v_load(all.r + l), here->distance);
    met |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(radius)) << l;
  }
  return met;
}

// Is a triangle so close to the place that the mesh's own may be on its other side?
static int nsvcd__surface_is_near(nsvcd__proof *p, const nsvcd__geometry *f,
                                  nsvcd__d3 position, double tolerance) {
  const nsvcd_body *b = f->body;
  const nsvcd__d3 point[3] = {position, position, position};
  const nsvcd__f3 rounded = nsvcd__f3_round(position);
  const nsvcd__box at = {rounded, rounded};
  const float extent = nsvcd__f3_length(rounded) + b->extent;
  const float distance =
      2 * nsvcd__widest_error(f) + (float)tolerance * 1.0001f + 4 * NSVCD__ROUNDING * extent;
  const nsvcd__surroundings here = {rounded, distance};
  nsvcd__block *block = &p->fixed_blocks[0];
  size_t g;
  nsvcd__traversal traversal;
  p->memo.window = 0;
  nsvcd__traversal_begin(&traversal, b, nsvcd__is_around, &here);
  while (nsvcd__traversal_next(&traversal, &g)) {
    const size_t first = NSVCD__GROUP * g;
    const nsvcd__spheres members = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    for (uint32_t met = nsvcd__is_around(&here, members); met; met &= met - 1) {
      const size_t i = first + nsvcd__low_bit(met);
      if (i >= b->patches) break;
      const double off = (double)nsvcd__off_mesh(f) + NSVCD__SAME_POSITION * (double)extent;
      const double limit = 2 * off + tolerance;
      const size_t end = f->first_triangle[i + 1];
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        p->work++;
        uint32_t lanes = nsvcd__lanes_near(block, at, distance);
        for (; lanes; lanes &= lanes - 1) {
          nsvcd__d3 corners[3];
          nsvcd__patch_triangle(f, i, n + nsvcd__low_bit(lanes), corners);
          if (nsvcd__nearest_of(point, corners).square <= limit * limit) return 1;
        }
      }
    }
  }
  return 0;
}

// Does the body enclose a place of its frame, farther from its surface than rounding? Rays in
// directions that no mesh is likely to be aligned with, the first one on the side of the body on
// which the place is. One is enough where all is closed. Of what is nearly a solid most are asked,
// which is whether it winds about the place by more than a half (Jacobson 2013): then it is not
// known to be outside. unit: of its frame.
static int nsvcd__is_enclosed(nsvcd__proof *p, const nsvcd__geometry *f, double unit,
                              nsvcd__d3 position) {
  static const double directions[8][3] = {
      {0.5359, 0.6013, 0.5927},   {-0.5741, 0.6229, 0.5314},  {0.6127, -0.5531, 0.5644},
      {-0.5477, -0.5923, 0.5909}, {0.6311, 0.5573, -0.5396},  {-0.6053, 0.5297, -0.5941},
      {0.5623, -0.6217, -0.5452}, {-0.5849, -0.5407, -0.6047}};
  const nsvcd__d3 centre = nsvcd__d3_load(f->body->centre);
  const nsvcd__d3 off = nsvcd__d3_sub(position, centre);
  const double radius = (double)f->body->radius;
  if (f->body->open || nsvcd__d3_dot(off, off) > 1.00001 * radius * radius) return 0;
  const size_t best = (off.x < 0 ? 1u : 0u) + (off.y < 0 ? 2u : 0u) + (off.z < 0 ? 4u : 0u);
  nsvcd__ray ray;
  ray.from = position;
  ray.margin = NSVCD__SAME_POSITION * (double)p->given.lengths / unit;
  ray.margin += (double)nsvcd__off_mesh(f) + (double)f->counts->gap;
  ray.rounding = (float)ray.margin + 4 * NSVCD__ROUNDING * f->body->extent;
  int clear = 0;
  int odd = 0;
  for (size_t n = 0; n < 8 && p->work <= p->ask.limit; n++) {
    const double *d = directions[best ^ n];
    ray.direction = nsvcd__d3_of(d[0], d[1], d[2]);
    ray.direction = nsvcd__d3_scale(ray.direction, 1 / nsvcd__d3_length(ray.direction));
    const nsvcd__crossings sum = nsvcd__cross_all(p, f, &ray);
    if (sum.unclear) continue;
    if (sum.winds != 0 && sum.either_way % 2 == 0) return 1;
    if (sum.winds == 0 && sum.either_way % 2 != 0) return 1;
    if (f->kind_bits == 1) return 0;
    // in a hollow the one may undo the other
    odd += sum.nearly % 2 != 0 || sum.winds != 0;
    clear++;
  }
  if (clear == 0 || 2 * odd > clear) p->unclear = 1;
  p->in_open |= clear > 0 && 2 * odd > clear;
  return 0;
}

// Does some surface of a body lie outside of a sphere about the other? start: from the frame of the
// first to that of the second, in which the first is of this scale.
static int nsvcd__sticks_out(const nsvcd__geometry *inner, const nsvcd__transform *start,
                             float scale, const nsvcd_body *outer) {
  const nsvcd_body *b = inner->body;
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_load(outer->centre));
  const float rounding = 4 * NSVCD__ROUNDING * (scale * b->extent + outer->extent);
  const nsvcd__v radius = nsvcd__v_set(outer->radius + rounding);
  for (size_t first = 0; first < b->padded; first += NSVCD__LANES) {
    const nsvcd__spheres patches = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    uint32_t out = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 own = nsvcd__v3_centres(patches, l);
      const nsvcd__v3 posed = nsvcd__v3_transform(start, own);
      const nsvcd__v3 d = nsvcd__v3_sub(posed, centre);
      const nsvcd__v own_radius = nsvcd__v_load(patches.r + l);
      const nsvcd__v limit = nsvcd__v_fma(nsvcd__v_set(scale), own_radius, radius);
      out |= nsvcd__v_lt(nsvcd__v_mul(limit, limit), nsvcd__v3_dot(d, d)) << l;
    }
    for (; out; out &= out - 1) {
      const size_t i = first + nsvcd__low_bit(out);
      if (i < inner->body->patches && inner->hull_counts[i]) return 1;
    }
  }
  return 0;
}

// Seeds first .. first + 15 that may be in the sphere and in the box about the other body.
static uint32_t nsvcd__seeds_near(const nsvcd__geometry *inner, size_t first,
                                  const nsvcd__transform *start, float scale,
                                  const nsvcd__geometry *outer) {
  const nsvcd_body *o = outer->body;
  const size_t left = inner->counts->components - first;
  float lanes[3][NSVCD__LANES];
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const float *seed = inner->seeds + 3 * (first + (l < left ? l : 0));
    for (size_t k = 0; k < 3; k++) lanes[k][l] = seed[k];
  }
  const nsvcd__f3 centre = nsvcd__f3_of(o->centre[0], o->centre[1], o->centre[2]);
  const float extent =
      nsvcd__f3_length(start->position) + scale * inner->body->extent + o->extent;
  const float rounding = 4 * NSVCD__ROUNDING * extent;
  uint32_t nearby = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 seen = nsvcd__v3_transform(start, nsvcd__v3_load(lanes, l));
    const nsvcd__v3 d = nsvcd__v3_sub(seen, nsvcd__v3_set(centre));
    const nsvcd__v radius = nsvcd__v_set(o->radius + rounding);
    const nsvcd__v at[3] = {seen.x, seen.y, seen.z};
    uint32_t slice = nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_mul(radius, radius));
    for (size_t k = 0; k < 3; k++) {
      slice &= nsvcd__v_le(nsvcd__v_set(outer->box[k] - rounding), at[k]);
      slice &= nsvcd__v_le(at[k], nsvcd__v_set(outer->box[3 + k] + rounding));
    }
    nearby |= slice << l;
  }
  return nearby;
}

// The pose that takes the fixed body's frame to the moving one's, which is of this scale: rows are
// those of the inverse rotation, over it.
static nsvcd__dtransform nsvcd__inverse_dtransform(const nsvcd__dtransform *at, double scale) {
  const double inverse = 1 / (scale * scale);
  nsvcd__dtransform out;
  const nsvcd__dmat3 transpose = nsvcd__dmat3_transpose(at->rotation);
  out.rotation = nsvcd__dmat3_scale(&transpose, inverse);
  out.position = nsvcd__d3_scale(nsvcd__dmat3_apply(&out.rotation, at->position), -1);
  return out;
}

// One body at the start of the motion, as the other sees it.
typedef struct nsvcd__enclosure {
  const nsvcd__geometry *inner, *outer;
  // of the inner body in the outer one's frame, the same rounded, and the other way round
  nsvcd__dtransform start;
  nsvcd__transform rounded;
  nsvcd__dtransform back;
  float scale;  // of the inner body, in that frame
  // of that frame: the fixed body's units
  double unit;
  // it is the motion's moving body
  int inner_moves;
} nsvcd__enclosure;

// Are some of the inner body's components, those with seeds from `first` to `end`, within the outer
// one? Then p->enclosed has the point, and p->within is set; 1 if that is certain.
static int nsvcd__encloses_seeds(nsvcd__proof *p, const nsvcd__enclosure *e, size_t first,
                                 size_t end) {
  uint32_t nearby = 0;
  for (size_t n = first; n < end; n++) {
    const size_t l = (n - first) % NSVCD__LANES;
    if (l == 0) nearby = nsvcd__seeds_near(e->inner, n, &e->rounded, e->scale, e->outer);
    if (!(nearby >> l & 1)) continue;
    if (nsvcd__is_exhausted(p)) {
      p->unclear = 1;
      return 0;
    }
    const nsvcd__d3 seed = nsvcd__d3_load(e->inner->seeds + 3 * n);
    const nsvcd__d3 seen = nsvcd__d3_transform(&e->start, seed);
    if (!nsvcd__is_enclosed(p, e->outer, e->unit, seen)) continue;
    p->enclosed = e->inner_moves ? seen : seed;
    p->inside = 1;
    const double room = p->given.tolerance / e->unit + (double)e->outer->counts->gap;
    if (!nsvcd__surface_is_near(p, e->outer, seen, room)) return 1;
  }
  return 0;
}

// The same of all components. Where they are many, only those of groups that come near the outer
// body are asked for.
static int nsvcd__encloses_any(nsvcd__proof *p, const nsvcd__enclosure *e) {
  const nsvcd_body *inner = e->inner->body;
  const nsvcd_body *outer = e->outer->body;
  if (outer->open) return 0;
  const int is_one = e->inner->counts->components == 1 && e->outer->kind_bits == 1;
  if (is_one && nsvcd__sticks_out(e->inner, &e->rounded, e->scale, outer)) return 0;
  if (e->inner->counts->components <= NSVCD__LANES)
    return nsvcd__encloses_seeds(p, e, 0, e->inner->counts->components);
  const nsvcd__f3 centre =
      nsvcd__f3_round(nsvcd__d3_transform(&e->back, nsvcd__d3_load(outer->centre)));
  const float extent = nsvcd__f3_length(centre) + inner->extent + outer->extent / e->scale;
  const nsvcd__surroundings here = {centre,
                                    outer->radius / e->scale + 4 * NSVCD__ROUNDING * extent};
  size_t g;
  nsvcd__traversal traversal;
  nsvcd__traversal_begin(&traversal, inner, nsvcd__is_around, &here);
  while (!p->unclear && nsvcd__traversal_next(&traversal, &g)) {
    if (nsvcd__encloses_seeds(p, e, e->inner->first_seed[g], e->inner->first_seed[g + 1]))
      return 1;
  }
  return 0;
}

// Is a component of one body within the other at the start of the motion? Then p->enclosed is its
// point. Where that is so close to the surface that what that is off by matters, 0 is returned and
// p->within is set: if planes then separate all patches at t = 0, the point, the surface that was
// looked at and the true one, patch by patch on one side of a plane, agree, and it is within.
static NSVCD__NOINLINE int nsvcd__is_contained_at_start(nsvcd__proof *p) {
  nsvcd__enclosure moving, fixed;
  moving.start = nsvcd__dtransform_at(nsvcd__arc_at(p, 0), 0);
  moving.back = nsvcd__inverse_dtransform(&moving.start, p->arc.scale);
  moving.rounded = nsvcd__transform_of(&moving.start);
  moving.inner = fixed.outer = &p->moving;
  moving.outer = fixed.inner = &p->fixed;
  moving.scale = p->ask.motion->scale;
  moving.unit = 1;
  moving.inner_moves = 1;
  fixed.start = moving.back;
  fixed.back = moving.start;
  fixed.rounded = nsvcd__transform_of(&fixed.start);
  fixed.scale = 1 / p->ask.motion->scale;
  fixed.unit = p->arc.scale;
  fixed.inner_moves = 0;
  return nsvcd__encloses_any(p, &moving) || nsvcd__encloses_any(p, &fixed);
}
#endif  // NSVCD_NO_PROOF
