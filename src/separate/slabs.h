// In: patch pairs, a slice at a time. Out: those that no plane normal to a slab separates.
#pragma once
#include "../interface/queries.h"
#include "../search/search.h"
#include "../triangles/motion_bounds.h"

#ifndef NSVCD_NO_PROOF
// nsvcd__interval and nsvcd__deviation_of for a slice of directions, or for one direction in a
// slice of intervals.
typedef struct nsvcd__v_interval {
  nsvcd__v3 axis, heading;
  nsvcd__v rounding, origin_bend, bend, bend_along_axis, origin_along_axis, origin_off_heading;
} nsvcd__v_interval;

NSVCD__INLINE nsvcd__v_interval nsvcd__v_interval_set(const nsvcd__interval *over) {
  nsvcd__v_interval out;
  out.axis = nsvcd__v3_set(over->axis);
  out.heading = nsvcd__v3_set(over->heading);
  out.rounding = nsvcd__v_set(over->rounding);
  out.origin_bend = nsvcd__v_set(over->origin_bend);
  out.bend = nsvcd__v_set(over->bend);
  out.bend_along_axis = nsvcd__v_set(over->bend_along_axis);
  out.origin_along_axis = nsvcd__v_set(over->origin_along_axis);
  out.origin_off_heading = nsvcd__v_set(over->origin_off_heading);
  return out;
}
// A slice of a block, from lane l on.
NSVCD__INLINE nsvcd__v_interval nsvcd__v_interval_load(nsvcd__segments *block, size_t l) {
  nsvcd__v_interval out;
  out.axis = nsvcd__v3_load(block->axis, l);
  out.heading = nsvcd__v3_load(block->heading, l);
  out.rounding = nsvcd__v_load(block->rounding + l);
  out.origin_bend = nsvcd__v_load(block->origin_bend + l);
  out.bend = nsvcd__v_load(block->bend + l);
  out.bend_along_axis = nsvcd__v_load(block->bend_along_axis + l);
  out.origin_along_axis = nsvcd__v_load(block->origin_along_axis + l);
  out.origin_off_heading = nsvcd__v_load(block->origin_off_heading + l);
  return out;
}
NSVCD__INLINE nsvcd__v nsvcd__v_deviation(const nsvcd__v_interval *over, nsvcd__v3 n,
                                          float from_origin) {
  const nsvcd__v along = nsvcd__v_abs(nsvcd__v3_dot(n, over->axis));
  const nsvcd__v across = nsvcd__v3_norm(nsvcd__v3_cross(n, over->axis));
  const nsvcd__v ahead = nsvcd__v_abs(nsvcd__v3_dot(n, over->heading));
  const nsvcd__v aside = nsvcd__v3_norm(nsvcd__v3_cross(n, over->heading));
  nsvcd__v by_axis = nsvcd__v_mul(across, over->origin_bend);
  by_axis = nsvcd__v_fma(along, over->origin_along_axis, by_axis);
  nsvcd__v by_heading = nsvcd__v_mul(aside, over->origin_off_heading);
  by_heading = nsvcd__v_fma(ahead, over->origin_bend, by_heading);
  nsvcd__v turn = nsvcd__v_mul(across, over->bend);
  turn = nsvcd__v_fma(along, over->bend_along_axis, turn);
  return nsvcd__v_fma(turn, nsvcd__v_set(from_origin), nsvcd__v_min(by_axis, by_heading));
}

// A slice of slabs.
typedef struct nsvcd__v_slab {
  nsvcd__v3 normal;
  nsvcd__v low, high, across;
} nsvcd__v_slab;

NSVCD__INLINE nsvcd__v_slab nsvcd__v_slab_set(const nsvcd__slab *slab) {
  nsvcd__v_slab out;
  out.normal = nsvcd__v3_set(slab->normal);
  out.low = nsvcd__v_set(slab->low);
  out.high = nsvcd__v_set(slab->high);
  out.across = nsvcd__v_set(slab->across);
  return out;
}
// From (6, stride).
NSVCD__INLINE nsvcd__v_slab nsvcd__v_slab_load(const float *slabs, size_t stride) {
  nsvcd__v_slab out;
  out.normal = nsvcd__v3_get(slabs, stride);
  out.low = nsvcd__v_load(slabs + 3 * stride);
  out.high = nsvcd__v_load(slabs + 4 * stride);
  out.across = nsvcd__v_load(slabs + 5 * stride);
  return out;
}

// Extents of slabs, from their centres, along directions of these components: along the slabs'
// normals, and across them.
NSVCD__INLINE nsvcd__v_range nsvcd__v_slab_along(const nsvcd__v_slab *slab, nsvcd__v along,
                                                 nsvcd__v across) {
  const nsvcd__v a = nsvcd__v_mul(slab->low, along);
  const nsvcd__v b = nsvcd__v_mul(slab->high, along);
  const nsvcd__v side = nsvcd__v_mul(slab->across, across);
  nsvcd__v_range out;
  out.low = nsvcd__v_sub(nsvcd__v_min(a, b), side);
  out.high = nsvcd__v_add(nsvcd__v_max(a, b), side);
  return out;
}

// The same, along directions given in the slabs' own frame.
NSVCD__INLINE nsvcd__v_range nsvcd__v_slab_range(const nsvcd__v_slab *slab, nsvcd__v3 n) {
  const nsvcd__v along = nsvcd__v3_dot(n, slab->normal);
  const nsvcd__v across = nsvcd__v3_norm(nsvcd__v3_cross(n, slab->normal));
  return nsvcd__v_slab_along(slab, along, across);
}

// Moving slabs that approach fixed ones over an interval; either of them, and the interval, may
// be the same in all lanes.
typedef struct nsvcd__v_approach {
  // in its body's frame and units
  nsvcd__v_slab moving;
  nsvcd__v_slab fixed;
  // from the fixed centre to the moving one, and its travel
  nsvcd__v3 from, chord;
  // the fixed slab's normal in the moving body's frame, at both ends
  nsvcd__v3 at_start, at_end;
  // the mean of the moving slab's normals at both ends, and half their difference
  nsvcd__v3 mean, turned;
  // does any point leave its chord?
  int may_bend;
  // of the moving body
  nsvcd__v scale;
  nsvcd__v_interval over;
  float clearance;
  // of the moving slabs' points about their body's origin, in its units
  float radius;
  // nsvcd__v_off along the fixed slab's normal
  nsvcd__v fixed_off;
} nsvcd__v_approach;

// Along a plane's normal: the deviation of a moving point, and the clearance.
NSVCD__INLINE nsvcd__v nsvcd__v_off(const nsvcd__v_approach *a, nsvcd__v3 plane) {
  const nsvcd__v allowed = nsvcd__v_plus(a->over.rounding, a->clearance);
  if (!a->may_bend) return allowed;
  return nsvcd__v_add(allowed, nsvcd__v_deviation(&a->over, plane, a->radius));
}

// Lanes that planes with this normal separate. start, end, fixed: the slabs' extents along it, the
// moving one's at both ends, each from its centre.
NSVCD__INLINE uint32_t nsvcd__v_separate(const nsvcd__v_approach *a, nsvcd__v3 plane,
                                         nsvcd__v_range start, nsvcd__v_range end,
                                         nsvcd__v_range fixed, nsvcd__v off) {
  const nsvcd__v height = nsvcd__v3_dot(plane, a->from);
  const nsvcd__v height_end = nsvcd__v_add(height, nsvcd__v3_dot(plane, a->chord));
  const nsvcd__v low =
      nsvcd__v_min(nsvcd__v_add(height, start.low), nsvcd__v_add(height_end, end.low));
  const nsvcd__v high =
      nsvcd__v_max(nsvcd__v_add(height, start.high), nsvcd__v_add(height_end, end.high));
  const uint32_t below = nsvcd__v_lt(high, nsvcd__v_sub(fixed.low, off));
  return below | nsvcd__v_lt(nsvcd__v_add(fixed.high, off), low);
}

// Lanes that planes with the fixed slabs' normals separate.
NSVCD__INLINE uint32_t nsvcd__v_separate_by_fixed(const nsvcd__v_approach *a) {
  const nsvcd__v_range fixed = {a->fixed.low, a->fixed.high};
  const nsvcd__v_range start = nsvcd__v_slab_range(&a->moving, a->at_start);
  if (!a->may_bend)
    return nsvcd__v_separate(a, a->fixed.normal, start, start, fixed, a->fixed_off);
  const nsvcd__v_range end = nsvcd__v_slab_range(&a->moving, a->at_end);
  return nsvcd__v_separate(a, a->fixed.normal, start, end, fixed, a->fixed_off);
}

// Lanes that planes with normal w separate: the mean of the moving slabs' normals, |w| <= 1. Both
// normals make the same angle with w: they are |w|^2 along it and no more than |turned| across it.
NSVCD__INLINE uint32_t nsvcd__v_separate_by_moving(const nsvcd__v_approach *a) {
  const nsvcd__v3 w = a->mean;
  const nsvcd__v along = nsvcd__v_mul(a->scale, nsvcd__v3_dot(w, w));
  const nsvcd__v across = nsvcd__v_mul(a->scale, nsvcd__v3_norm(a->turned));
  const nsvcd__v_range moving = nsvcd__v_slab_along(&a->moving, along, across);
  const nsvcd__v_range fixed = nsvcd__v_slab_range(&a->fixed, w);
  return nsvcd__v_separate(a, w, moving, moving, fixed, nsvcd__v_off(a, w));
}

// Of the lanes `met` of moving group g in segment s, those that slabs do not separate from fixed
// patch j.
static uint32_t nsvcd__slabs_meet(const nsvcd__proof *p, const nsvcd__interval *over,
                                  const nsvcd__search *q, size_t g, size_t j, size_t s,
                                  uint32_t met) {
  const nsvcd__chords *c = &q->members[s];
  const nsvcd__slab fixed = nsvcd__slab_at(p->fixed.slabs, p->fixed.body->padded, j);
  const nsvcd__f3 centre = nsvcd__patch_centre(&p->fixed, j);
  const nsvcd__mat3 *from = &over->start.rotation;
  const nsvcd__mat3 *to = &over->end.rotation;
  uint32_t left = 0;
  nsvcd__v_approach a;
  a.fixed = nsvcd__v_slab_set(&fixed);
  a.at_start = nsvcd__v3_set(nsvcd__mat3_apply_transpose(from, fixed.normal));
  a.at_end = nsvcd__v3_set(nsvcd__mat3_apply_transpose(to, fixed.normal));
  a.may_bend = nsvcd__may_bend(over);
  a.scale = nsvcd__v_set(p->arcs.motion->scale);
  a.over = nsvcd__v_interval_set(over);
  a.clearance = nsvcd__clearance(&p->goal);
  a.radius = q->extent;
  a.fixed_off = nsvcd__v_off(&a, a.fixed.normal);
  NSVCD__EACH_SLICE(l) {
    const size_t i = NSVCD__GROUP * g + l;
    uint32_t wanted = met >> l & NSVCD__SLICE_MASK;
    if (!wanted) continue;
    a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
    a.chord = nsvcd__chords_travel(c, l);
    a.moving = nsvcd__v_slab_load(p->moving.slabs + i, p->moving.body->padded);
    wanted &= ~nsvcd__v_separate_by_fixed(&a);
    if (!wanted) continue;
    // rotations in an interval are times the scale
    const float half = 0.5f * p->arcs.motion->per_scale;
    const nsvcd__mat3 middle = nsvcd__mat3_mix(half, to, 1, from);
    const nsvcd__mat3 half_turn = nsvcd__mat3_mix(half, to, -1, from);
    a.mean = nsvcd__vmat3_apply(nsvcd__vmat3_set(&middle), a.moving.normal);
    a.turned = nsvcd__vmat3_apply(nsvcd__vmat3_set(&half_turn), a.moving.normal);
    left |= (wanted & ~nsvcd__v_separate_by_moving(&a)) << l;
  }
  return left;
}

// Clears the segments in which slabs separate the moving group that is searched, whose chords are
// in q->group, from the fixed ones that it meets: a slice of segments at a time.
static NSVCD__NOINLINE void nsvcd__separate_groups(const nsvcd__proof *p, nsvcd__search *q) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const size_t next = q->order[q->step];
  const size_t g = q->moving_tile.groups[next];
  const nsvcd__slab own =
      nsvcd__slab_at(p->moving.group_slabs, nsvcd__group_slots(moving->padded), g);
  nsvcd__v_approach a;
  a.moving = nsvcd__v_slab_set(&own);
  a.may_bend = 1;  // in some segment
  a.scale = nsvcd__v_set(q->scale);
  a.clearance = nsvcd__clearance(&p->goal);
  a.radius = nsvcd__group_extent(moving, g);
  for (uint32_t waiting = q->waiting; waiting; waiting &= waiting - 1) {
    const size_t at = nsvcd__low_bit(waiting);
    const size_t h = q->fixed_tile.groups[at];
    const nsvcd__slab other =
        nsvcd__slab_at(p->fixed.group_slabs, nsvcd__group_slots(fixed->padded), h);
    const nsvcd__f3 centre = nsvcd__centre_of(nsvcd__groups_of(fixed), h);
    uint64_t *met = &nsvcd__nearby(q, next)[at];
    a.fixed = nsvcd__v_slab_set(&other);
    for (size_t first = 0; first < NSVCD__MAX_SEGMENTS; first += NSVCD__SLICE) {
      const uint32_t wanted = (uint32_t)(*met >> first) & NSVCD__SLICE_MASK;
      nsvcd__segments *block = &q->blocks[first / NSVCD__LANES];
      const nsvcd__chords *c = &q->group[first / NSVCD__LANES];
      const size_t l = first % NSVCD__LANES;
      if (!wanted) continue;
      const nsvcd__vmat3 rotation = nsvcd__vmat3_load(block->rotation, l);
      const nsvcd__vmat3 turn = nsvcd__vmat3_load(block->turned, l);
      const nsvcd__v half = nsvcd__v_set(0.5f / q->scale);
      const nsvcd__v whole = nsvcd__v_set(1 / q->scale);
      const nsvcd__v3 n = a.fixed.normal;
      const nsvcd__v3 m = a.moving.normal;
      a.over = nsvcd__v_interval_load(block, l);
      a.fixed_off = nsvcd__v_off(&a, n);
      a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
      a.chord = nsvcd__chords_travel(c, l);
      a.at_start = nsvcd__vmat3_apply_transpose(rotation, n);
      a.at_end = nsvcd__v3_add(a.at_start, nsvcd__vmat3_apply_transpose(turn, n));
      a.turned = nsvcd__v3_scale(nsvcd__vmat3_apply(turn, m), half);
      a.mean = nsvcd__v3_fma(whole, nsvcd__vmat3_apply(rotation, m), a.turned);
      const uint32_t apart = nsvcd__v_separate_by_fixed(&a) | nsvcd__v_separate_by_moving(&a);
      *met &= ~((uint64_t)(apart & wanted) << first);
    }
    if (!*met) q->waiting &= ~((uint32_t)1 << at);
  }
}
// The way of the moving group in a segment, up to the end of what matters.
typedef struct nsvcd__way {
  size_t segment;
  double start, length;  // ticks
  // the chord of its sphere
  nsvcd__f3 from, travel;
  float inverse, radius;
  // its slab, against 16 others
  nsvcd__v_approach slabs;
  nsvcd__vmat3 at_start, at_end;
} nsvcd__way;

// Of 16 spheres of the fixed body, those `met` whose slabs no plane normal to one separates from
// that of the moving group: groups, if `level` is 1, or patches, 0, from number `first` on.
static uint32_t nsvcd__slabs_on_way(const nsvcd__solver *w, nsvcd__way *way,
                                    nsvcd__spheres spheres, size_t level, size_t first,
                                    uint32_t met) {
  const nsvcd__geometry *f = &w->p.fixed;
  const float *slabs = (level > 0 ? f->group_slabs : f->slabs) + first;
  const size_t padded = f->body->padded;
  const size_t stride = level > 0 ? nsvcd__group_slots(padded) : padded;
  const int is_point = w->p.moving.body->patches == 1 && w->p.moving.hull_counts[0] == 1;
  nsvcd__v_approach *a = &way->slabs;
  uint32_t left = 0;
  NSVCD__EACH_SLICE(l) {
    uint32_t wanted = met >> l & NSVCD__SLICE_MASK;
    if (!wanted) continue;
    a->from = nsvcd__v3_sub(nsvcd__v3_set(way->from), nsvcd__v3_centres(spheres, l));
    a->fixed = nsvcd__v_slab_load(slabs + l, stride);
    a->at_start = nsvcd__vmat3_apply_transpose(way->at_start, a->fixed.normal);
    a->at_end = nsvcd__vmat3_apply_transpose(way->at_end, a->fixed.normal);
    a->fixed_off = nsvcd__v_off(a, a->fixed.normal);
    wanted &= ~nsvcd__v_separate_by_fixed(a);
    if (wanted && !is_point) wanted &= ~nsvcd__v_separate_by_moving(a);
    left |= wanted << l;
  }
  return left;
}
#endif  // NSVCD_NO_PROOF
