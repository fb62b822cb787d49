// In: two bodies that do not touch at a time. Out: is a component of one inside the other? By rays,
// in double.
#pragma once
#include "../triangles/triangle_pairs.h"
#include "blocks.h"

#ifndef NSVCD_NO_PROOF
// A ray in a body's frame. What it crosses tells whether the body encloses the point it starts at.
typedef struct nsvcd__ray {
  nsvcd__d3 from, direction;
  // A ray that passes an edge within this tells nothing. rounding: the same plus what floats add.
  double margin;
  float rounding;
} nsvcd__ray;

// +1 if the ray leaves through the triangle, -1 if it enters, 0 if it misses. Sets *unclear if it
// passes an edge.
static int nsvcd__ray_crosses(const nsvcd__ray *ray, const nsvcd__d3 *t, double margin,
                              int *unclear) {
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  double nearest = HUGE_VAL;
  const nsvcd__d3 n = nsvcd__face_normal(t);
  // the signed volumes of each edge and the ray: all of one sign if it passes inside
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    const nsvcd__d3 across = nsvcd__d3_cross(edge, ray->direction);
    const double length = nsvcd__d3_norm(across);
    const double volume = nsvcd__d3_dot(across, nsvcd__d3_sub(t[k], ray->from));
    least = nsvcd__min(least, volume);
    most = nsvcd__max(most, volume);
    nearest = nsvcd__min(nearest, length > 0 ? fabs(volume) / length : 0);
  }
  const double slope = nsvcd__d3_dot(n, ray->direction);
  const double height = nsvcd__d3_dot(n, nsvcd__d3_sub(t[0], ray->from));
  const double size = nsvcd__d3_norm(n);
  const int is_on_it = fabs(height) <= margin * size;
  if (height * slope < 0 && !is_on_it) return 0;  // it is behind
  if (nearest <= margin) {
    // It is near an edge's line, but is it near the triangle?
    nsvcd__d3 far_end = nsvcd__d3_add(ray->from, nsvcd__d3_scale(ray->direction, 4 * 1.6e7));
    nsvcd__nearest near_edge = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < 3; k++)
      nsvcd__edges_nearest(ray->from, far_end, t[k], t[(k + 1) % 3], &near_edge);
    if (near_edge.square <= 4 * margin * margin) *unclear = 1;
    if (least < 0 && most > 0) return 0;
  }
  if (least <= 0 && most >= 0) return 0;
  if (is_on_it) *unclear = 1;
  return slope > 0 ? 1 : slope < 0 ? -1 : 0;
}

// Adds a triangle to the list of those that a ray has crossed. Returns 0 if it is there already.
// Sets *unclear if there is no room.
static int nsvcd__is_new(nsvcd__solver *w, size_t *count, uint32_t number, int *unclear) {
  for (size_t k = 0; k < *count; k++) {
    if (w->crossed[k] == number) return 0;
  }
  if (*count == NSVCD__CROSSED) *unclear = 1;
  if (*count < NSVCD__CROSSED) w->crossed[(*count)++] = number;
  return 1;
}

// Lanes of a block whose triangles the ray crosses, or passes within the margin, and some more. The
// signed volumes of the edges and the ray are off by no more than `rounding`, square metres: see
// nsvcd__cross_all.
static uint32_t nsvcd__lanes_on_ray(nsvcd__block *block, const nsvcd__ray *ray, float margin,
                                    float rounding) {
  const nsvcd__f3 start = nsvcd__f3_round(ray->from);
  const nsvcd__f3 heading = nsvcd__f3_round(ray->direction);
  uint32_t missed = 0;
  NSVCD__EACH_SLICE(l) {
    nsvcd__v least = nsvcd__v_set(HUGE_VALF);
    nsvcd__v most = nsvcd__v_set(-HUGE_VALF);
    nsvcd__v longest = nsvcd__v_set(0);
    for (size_t k = 0; k < 3; k++) {
      const nsvcd__v3 corner = nsvcd__v3_load(block->corners[k], l);
      const nsvcd__v3 next = nsvcd__v3_load(block->corners[(k + 1) % 3], l);
      const nsvcd__v3 edge = nsvcd__v3_sub(next, corner);
      const nsvcd__v3 across = nsvcd__v3_cross(edge, nsvcd__v3_set(heading));
      const nsvcd__v3 to_corner = nsvcd__v3_sub(corner, nsvcd__v3_set(start));
      const nsvcd__v volume = nsvcd__v3_dot(across, to_corner);
      least = nsvcd__v_min(least, volume);
      most = nsvcd__v_max(most, volume);
      longest = nsvcd__v_max(longest, nsvcd__v3_dot(across, across));
    }
    const nsvcd__v allowed =
        nsvcd__v_fma(nsvcd__v_set(margin), nsvcd__v_sqrt(longest), nsvcd__v_set(rounding));
    missed |= (nsvcd__v_lt(least, nsvcd__v_negate(allowed)) & nsvcd__v_lt(allowed, most)) << l;
  }
  return nsvcd__block_lanes(block) & ~missed;
}

// What a ray crosses.
typedef struct nsvcd__crossings {
  int winds;       // how often the closed surfaces wind about the ray's point
  int either_way;  // triangles of surfaces whose winding tells nothing
  int nearly;      // triangles of what is nearly a solid
  int unclear;     // the ray cannot tell
} nsvcd__crossings;

// What one ray crosses. A triangle counts once, even if several patches list it or parts of it. A
// ray that comes as near to an edge as a closed gap is wide does not count: so none passes through
// a gap.
//
// The error of the signed volumes of nsvcd__lanes_on_ray, with u = 2^-24, E the extent, and R the
// extent plus the distance of the ray's point: A corner, a vertex of up to E from a centre of up to
// E, is off by 2 u E. An edge, of up to 2 E, is off by two corners and its own rounding, 6 u E. Its
// product with the direction, rounded as well, is off by 6 + 2 + 2.31 x 2 (|a_y b_z| + |a_z b_y|
// and so on are no more than 1.155 |a| |b| together) = 12.7 u E. A point on the edge, up to R from
// the ray's, is off by 3 u R. So the volume is off by 12.7 u E R + 2 E x 3 u R, and by 3 roundings
// of up to 2 E R: 24.7 u E R, less than 1.5e-6 E R. NSVCD__ROUNDING is more.
static nsvcd__crossings nsvcd__cross_all(nsvcd__solver *w, const nsvcd__geometry *f,
                                         const nsvcd__ray *ray) {
  nsvcd__proof *p = &w->p;
  nsvcd__block *block = &w->blocks.fixed[0];
  w->blocks.window = 0;
  const float extent = (float)nsvcd__d3_norm(ray->from) + f->body->extent;
  const float rounding = NSVCD__ROUNDING * extent * f->body->extent;
  nsvcd__crossings sum = {0, 0, 0, 0};
  size_t count = 0;
  size_t g;
  const nsvcd__beam beam = {nsvcd__f3_round(ray->from), nsvcd__f3_round(ray->direction),
                            ray->rounding};
  nsvcd__traversal groups;
  nsvcd__traversal_begin(&groups, f->body, nsvcd__is_on_beam, &beam);
  while (!sum.unclear && nsvcd__traversal_next(&groups, &g)) {
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
          if (!crossing || !nsvcd__is_new(w, &count, numbers.number, &sum.unclear)) continue;
          if (numbers.kind == NSVCD__CLOSED) sum.winds += crossing;
          sum.either_way += numbers.kind == NSVCD__EITHER_DIRECTION;
          sum.nearly += numbers.kind == NSVCD__NEARLY;
        }
      }
    }
  }
  return sum;
}

// Lanes of 16 spheres that meet this one; a filter of a traversal.
static uint32_t nsvcd__meets_sphere(const void *what, nsvcd__spheres all) {
  const nsvcd__sphere *here = (const nsvcd__sphere *)what;
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_set(here->centre);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), centre);
    const nsvcd__v radius = nsvcd__v_plus(nsvcd__v_load(all.r + l), here->radius);
    met |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(radius)) << l;
  }
  return met;
}

// Is a triangle so close to the point that the mesh's own may be on the other side of it?
static int nsvcd__surface_is_near(nsvcd__solver *w, const nsvcd__geometry *f, nsvcd__d3 point,
                                  double tolerance) {
  const nsvcd_body *b = f->body;
  const nsvcd__d3 as_triangle[3] = {point, point, point};
  const nsvcd__f3 rounded = nsvcd__f3_round(point);
  const nsvcd__box at = {rounded, rounded};
  const float extent = nsvcd__f3_norm(rounded) + b->extent;
  const float distance =
      2 * nsvcd__widest_error(f) + (float)tolerance * 1.0001f + 4 * NSVCD__ROUNDING * extent;
  const double off = (double)nsvcd__off_mesh(f) + NSVCD__SAME_POSITION * (double)extent;
  const double limit = 2 * off + tolerance;
  const nsvcd__sphere here = {rounded, distance};
  nsvcd__block *block = &w->blocks.fixed[0];
  size_t g;
  nsvcd__traversal groups;
  w->blocks.window = 0;
  nsvcd__traversal_begin(&groups, b, nsvcd__meets_sphere, &here);
  while (nsvcd__traversal_next(&groups, &g)) {
    const size_t first = NSVCD__GROUP * g;
    const nsvcd__spheres members = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    for (uint32_t met = nsvcd__meets_sphere(&here, members); met; met &= met - 1) {
      const size_t i = first + nsvcd__low_bit(met);
      if (i >= b->patches) break;
      const size_t end = f->first_triangle[i + 1];
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        w->p.work++;
        uint32_t lanes = nsvcd__lanes_near(block, at, distance);
        for (; lanes; lanes &= lanes - 1) {
          nsvcd__d3 corners[3];
          nsvcd__patch_triangle(f, i, n + nsvcd__low_bit(lanes), corners);
          if (nsvcd__nearest_of(as_triangle, corners).square <= limit * limit) return 1;
        }
      }
    }
  }
  return 0;
}

// A direction turned towards the nearest of those faces of the body's box that it leads to: a ray
// that leaves sooner meets less.
static nsvcd__d3 nsvcd__way_out(const nsvcd__geometry *f, nsvcd__d3 point,
                                nsvcd__d3 direction) {
  const double from[3] = {point.x, point.y, point.z};
  double along[3] = {direction.x, direction.y, direction.z};
  double least = HUGE_VAL;
  size_t nearest = 0;
  for (size_t k = 0; k < 3; k++) {
    const double face = (double)f->box[along[k] > 0 ? 3 + k : k];
    const double room = fabs(face - from[k]);
    if (room < least) nearest = k;
    least = nsvcd__min(least, room);
  }
  along[nearest] *= 3;
  return nsvcd__d3_of(along[0], along[1], along[2]);
}

// Does the body enclose a point of its frame, farther from its surface than rounding? Rays tell, in
// directions that no mesh is likely to be aligned with. The first one goes to the side of the body
// that the point is on, and more to the face of its box that is near there. One ray is enough where
// all surfaces are closed. Of what is nearly a solid, the majority of the rays tells whether its
// winding number is more than a half: then the point is not known to be outside. (Difference from
// Jacobson 2013: rays, not a sum of solid angles.) unit: of the body's frame.
static int nsvcd__is_enclosed(nsvcd__solver *w, const nsvcd__geometry *f, double unit,
                              nsvcd__d3 point) {
  nsvcd__proof *p = &w->p;
  static const double directions[8][3] = {
      {0.5359, 0.6013, 0.5927},   {-0.5741, 0.6229, 0.5314},  {0.6127, -0.5531, 0.5644},
      {-0.5477, -0.5923, 0.5909}, {0.6311, 0.5573, -0.5396},  {-0.6053, 0.5297, -0.5941},
      {0.5623, -0.6217, -0.5452}, {-0.5849, -0.5407, -0.6047}};
  const nsvcd__d3 centre = nsvcd__d3_load(f->body->centre);
  const nsvcd__d3 off = nsvcd__d3_sub(point, centre);
  const double radius = (double)f->body->radius;
  if (f->body->open || nsvcd__d3_dot(off, off) > 1.00001 * radius * radius) return 0;
  const size_t best = (off.x < 0 ? 1u : 0u) + (off.y < 0 ? 2u : 0u) + (off.z < 0 ? 4u : 0u);
  nsvcd__ray ray;
  ray.from = point;
  ray.margin = NSVCD__SAME_POSITION * (double)p->given.lengths / unit;
  ray.margin += (double)nsvcd__off_mesh(f) + (double)f->counts->gap;
  ray.rounding = (float)ray.margin + 4 * NSVCD__ROUNDING * f->body->extent;
  int clear = 0;
  int odd = 0;
  for (size_t n = 0; n < 8; n++) {
    const double *d = directions[best ^ n];
    if (p->work > p->goal.limit) {
      w->unclear = NSVCD__NOT_ASKED;
      return 0;
    }
    ray.direction = nsvcd__d3_of(d[0], d[1], d[2]);
    if (n == 0) ray.direction = nsvcd__way_out(f, point, ray.direction);
    ray.direction = nsvcd__d3_scale(ray.direction, 1 / nsvcd__d3_norm(ray.direction));
    const nsvcd__crossings sum = nsvcd__cross_all(w, f, &ray);
    if (sum.unclear) continue;
    // A hollow of one kind inside the other undoes it.
    if ((sum.winds != 0) != (sum.either_way % 2 != 0)) return 1;
    if (f->kind_bits == 1) return 0;
    odd += sum.nearly % 2 != 0 || sum.winds != 0;
    clear++;
  }
  if (clear == 0 || 2 * odd > clear) w->unclear = NSVCD__CANNOT_TELL;
  w->in_open |= clear > 0 && 2 * odd > clear;
  return 0;
}

// Does some patch of a body lie outside of the other's sphere? start: from the first body's frame
// to the second's, in which the first has this scale.
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
      const nsvcd__v3 seen = nsvcd__v3_transform(start, nsvcd__v3_centres(patches, l));
      const nsvcd__v3 d = nsvcd__v3_sub(seen, centre);
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

// Two bodies at the start of the motion: is `inner` in `outer`?
typedef struct nsvcd__enclosure {
  const nsvcd__geometry *inner, *outer;
  // from the inner body's frame to the outer one's, that in float, and its inverse
  nsvcd__dtransform start;
  nsvcd__transform rounded;
  nsvcd__dtransform back;
  // of the inner body in the outer one's frame; of that frame, in the fixed body's units
  float scale;
  double unit;
} nsvcd__enclosure;

// May a seed be in the outer body? It is in the sphere and the box about that.
static int nsvcd__seed_is_near(const nsvcd__enclosure *e, const float *seed) {
  const nsvcd_body *o = e->outer->body;
  const float extents = e->scale * e->inner->body->extent + o->extent;
  const float lengths = nsvcd__f3_norm(e->rounded.position) + extents;
  const float rounding = 4 * NSVCD__ROUNDING * lengths;
  const float radius = o->radius + rounding;
  const nsvcd__f3 margin = nsvcd__f3_of(rounding, rounding, rounding);
  const nsvcd__f3 low = nsvcd__f3_sub(nsvcd__f3_load(e->outer->box), margin);
  const nsvcd__f3 high = nsvcd__f3_add(nsvcd__f3_load(e->outer->box + 3), margin);
  const nsvcd__f3 seen = nsvcd__f3_transform(&e->rounded, nsvcd__f3_load(seed));
  const nsvcd__f3 d = nsvcd__f3_sub(seen, nsvcd__f3_load(o->centre));
  const int in_box = !nsvcd__f3_exceeds(low, seen) && !nsvcd__f3_exceeds(seen, high);
  return in_box && nsvcd__f3_dot(d, d) <= radius * radius;
}

// Is one of the inner body's components, with seeds first .. end - 1, in the outer body? Then
// w->inside is set, and w->enclosed is its seed. Returns 1 if that is certain.
static int nsvcd__contains_seeds(nsvcd__solver *w, const nsvcd__enclosure *e, size_t first,
                                 size_t end) {
  nsvcd__proof *p = &w->p;
  for (size_t n = first; n < end; n++) {
    if (!nsvcd__seed_is_near(e, e->inner->seeds + 3 * n)) continue;
    if (nsvcd__check_budget(p)) {
      w->unclear = NSVCD__NOT_ASKED;
      return 0;
    }
    const nsvcd__d3 seed = nsvcd__d3_load(e->inner->seeds + 3 * n);
    const nsvcd__d3 seen = nsvcd__d3_transform(&e->start, seed);
    if (!nsvcd__is_enclosed(w, e->outer, e->unit, seen)) continue;
    w->enclosed = e->inner == &p->moving ? seen : seed;
    w->inside = 1;
    const double room = p->given.tolerance / e->unit + (double)e->outer->counts->gap;
    if (!nsvcd__surface_is_near(w, e->outer, seen, room)) return 1;
  }
  return 0;
}

// The same of all components. Where there are many, only groups near the outer body are asked for
// theirs.
static int nsvcd__contains_any(nsvcd__solver *w, const nsvcd__enclosure *e) {
  const nsvcd_body *inner = e->inner->body;
  const nsvcd_body *outer = e->outer->body;
  // nor does a single triangle, segment or point enclose anything
  if (outer->open || outer->triangles < 2) return 0;
  const int is_one = e->inner->counts->components == 1 && e->outer->kind_bits == 1;
  if (is_one && nsvcd__sticks_out(e->inner, &e->rounded, e->scale, outer)) return 0;
  if (e->inner->counts->components <= NSVCD__LANES)
    return nsvcd__contains_seeds(w, e, 0, e->inner->counts->components);
  const nsvcd__f3 centre =
      nsvcd__f3_round(nsvcd__d3_transform(&e->back, nsvcd__d3_load(outer->centre)));
  const float extent = nsvcd__f3_norm(centre) + inner->extent + outer->extent / e->scale;
  const float rounding = 4 * NSVCD__ROUNDING * extent;
  const nsvcd__sphere here = {centre, outer->radius / e->scale + rounding};
  size_t g;
  nsvcd__traversal groups;
  nsvcd__traversal_begin(&groups, inner, nsvcd__meets_sphere, &here);
  while (!w->unclear && nsvcd__traversal_next(&groups, &g)) {
    if (nsvcd__contains_seeds(w, e, e->inner->first_seed[g], e->inner->first_seed[g + 1]))
      return 1;
  }
  return 0;
}

// Is a component of one body inside the other at the start of the motion? Then w->enclosed is its
// seed. A seed so close to the surface that errors matter returns 0, with w->inside set. If planes
// then separate all patches at t = 0, the seed, the surface that was tested and the true one are,
// patch by patch, on one side of a plane and agree: it is inside.
static NSVCD__NOINLINE int nsvcd__is_contained_at_start(nsvcd__solver *w) {
  nsvcd__proof *p = &w->p;
  const float scale = p->arcs.motion->scale;
  const nsvcd__dtransform start = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, 0), 0);
  const nsvcd__dtransform back = nsvcd__inverse_dtransform(&start, p->arcs.arc.scale);
  const nsvcd__enclosure moving = {&p->moving, &p->fixed, start, nsvcd__transform_of(&start),
                                   back,       scale,     1};
  if (nsvcd__contains_any(w, &moving)) return 1;
  const nsvcd__enclosure fixed = {
      &p->fixed, &p->moving,       back, nsvcd__transform_of(&back), start,
      1 / scale, p->arcs.arc.scale};
  return nsvcd__contains_any(w, &fixed);
}
#endif  // NSVCD_NO_PROOF
