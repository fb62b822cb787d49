// In: patch pairs, a slice at a time. Out: those that a plane along a slab's normal does not
// separate.
#pragma once
#include "../interface/plans.h"
#include "../search/search.h"
#include "motion_bounds.h"

#ifndef NSVCD_NO_PROOF
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
  out.normal = nsvcd__v3_load_rows(slabs, stride);
  out.low = nsvcd__v_load(slabs + 3 * stride);
  out.high = nsvcd__v_load(slabs + 4 * stride);
  out.across = nsvcd__v_load(slabs + 5 * stride);
  return out;
}

// By slabs, from their centres, along directions whose parts along the slabs' normals are `along`,
// and whose lengths across these are `across`.
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

// The extent of slabs along directions given in their own frame.
NSVCD__INLINE nsvcd__v_range nsvcd__v_slab_range(const nsvcd__v_slab *slab,
                                                 nsvcd__v3 direction) {
  const nsvcd__v along = nsvcd__v3_dot(direction, slab->normal);
  const nsvcd__v across = nsvcd__v3_length(nsvcd__v3_cross(direction, slab->normal));
  return nsvcd__v_slab_along(slab, along, across);
}

// Moving slabs that approach resting ones over a interval; either of them, and the interval, may be
// one in all lanes.
typedef struct nsvcd__v_approach {
  // in its body's frame and units
  nsvcd__v_slab moving;
  nsvcd__v_slab fixed;
  // from the resting centre to the moving one, and its way
  nsvcd__v3 from, chord;
  // the resting slab's normal in the moving body's frame, at both ends
  nsvcd__v3 at_start, at_end;
  // the mean of the moving slab's normals at both ends, and half of what they differ by
  nsvcd__v3 mean, turned;
  // of the moving body
  nsvcd__v scale;
  nsvcd__v_interval interval;
  float clearance;
  // no point of the moving side is farther from its body's origin, in its body's units
  float radius;
  // nsvcd__v_off, of the fixed slab's normal
  nsvcd__v fixed_off;
} nsvcd__v_approach;

// Lanes in which planes separate two bodies: the moving side is below, or above.
typedef struct nsvcd__v_separated {
  nsvcd__v3 plane;  // its normal
  uint32_t below, above;
} nsvcd__v_separated;

// Along a plane's normal: what a moving point may be off by, and the clearance.
NSVCD__INLINE nsvcd__v nsvcd__v_off(const nsvcd__v_approach *a, nsvcd__v3 plane) {
  const nsvcd__v allowed = nsvcd__v_plus(a->interval.rounding, a->clearance);
  return nsvcd__v_add(allowed, nsvcd__v_deviation(&a->interval, plane, a->radius));
}

NSVCD__INLINE nsvcd__v_separated nsvcd__v_separate(nsvcd__v3 plane, nsvcd__v_range moving,
                                                   nsvcd__v_range fixed, nsvcd__v off) {
  nsvcd__v_separated out;
  out.plane = plane;
  out.below = nsvcd__v_lt(moving.high, nsvcd__v_sub(fixed.low, off));
  out.above = nsvcd__v_lt(nsvcd__v_add(fixed.high, off), moving.low);
  return out;
}

// By planes normal to the resting slabs.
NSVCD__INLINE nsvcd__v_separated nsvcd__v_separate_by_fixed(const nsvcd__v_approach *a) {
  const nsvcd__v3 plane = a->fixed.normal;
  const nsvcd__v_range fixed = {a->fixed.low, a->fixed.high};
  const nsvcd__v_range start = nsvcd__v_slab_range(&a->moving, a->at_start);
  const nsvcd__v_range end = nsvcd__v_slab_range(&a->moving, a->at_end);
  const nsvcd__v height = nsvcd__v3_dot(plane, a->from);
  const nsvcd__v height_end = nsvcd__v_add(height, nsvcd__v3_dot(plane, a->chord));
  nsvcd__v_range moving;
  moving.low =
      nsvcd__v_min(nsvcd__v_add(height, start.low), nsvcd__v_add(height_end, end.low));
  moving.high =
      nsvcd__v_max(nsvcd__v_add(height, start.high), nsvcd__v_add(height_end, end.high));
  return nsvcd__v_separate(plane, moving, fixed, a->fixed_off);
}

// By planes normal to the mean w of the moving slabs' normals. |w| <= 1. Both normals make the same
// angle with w: along it they are |w|^2, across it no more than |turned|.
NSVCD__INLINE nsvcd__v_separated nsvcd__v_separate_by_moving(const nsvcd__v_approach *a) {
  const nsvcd__v3 w = a->mean;
  const nsvcd__v along = nsvcd__v_mul(a->scale, nsvcd__v3_dot(w, w));
  const nsvcd__v across = nsvcd__v_mul(a->scale, nsvcd__v3_length(a->turned));
  const nsvcd__v_range own = nsvcd__v_slab_along(&a->moving, along, across);
  const nsvcd__v height = nsvcd__v3_dot(w, a->from);
  const nsvcd__v height_end = nsvcd__v_add(height, nsvcd__v3_dot(w, a->chord));
  nsvcd__v_range moving;
  moving.low = nsvcd__v_add(nsvcd__v_min(height, height_end), own.low);
  moving.high = nsvcd__v_add(nsvcd__v_max(height, height_end), own.high);
  return nsvcd__v_separate(w, moving, nsvcd__v_slab_range(&a->fixed, w), nsvcd__v_off(a, w));
}

#ifdef NSVCD__CERTIFIES
// Patches i and j, by the plane in lane l of a slice.
static void nsvcd__certify_slab(size_t i, size_t j, const nsvcd__v_separated *separated,
                                size_t l, const nsvcd__interval *interval) {
  float lanes[3][NSVCD__LANES];
  float normal[3];
  nsvcd__v3_store(lanes, 0, separated->plane);
  const float sign = separated->below >> l & 1 ? -1.0f : 1.0f;
  nsvcd__f3_store(nsvcd__f3_scale(nsvcd__lane_of(lanes, l), sign), normal);
  NSVCD__CERTIFY(NSVCD__BY_SLAB, i, j, NSVCD_NONE, NSVCD_NONE, interval->t_start,
                 interval->t_end, normal);
}
// All pairs of members of groups g and h, in the segments `apart` of a slice that begins with
// segment `first`.
static void nsvcd__certify_groups(const nsvcd__proof *p, const nsvcd__search *search, size_t g,
                                  size_t h, size_t first, uint32_t apart,
                                  const nsvcd__v_separated *by_fixed,
                                  const nsvcd__v_separated *by_moving) {
  for (; apart; apart &= apart - 1) {
    const size_t l = nsvcd__low_bit(apart);
    const nsvcd__interval interval =
        nsvcd__interval_of_segment(p->ask.motion, search, first + l);
    const int is_fixed = (by_fixed->below | by_fixed->above) >> l & 1;
    for (size_t k = 0; k < NSVCD__GROUP * NSVCD__GROUP; k++) {
      const size_t i = NSVCD__GROUP * g + k / NSVCD__GROUP;
      const size_t j = NSVCD__GROUP * h + k % NSVCD__GROUP;
      if (i < p->moving.body->patches && j < p->fixed.body->patches)
        nsvcd__certify_slab(i, j, is_fixed ? by_fixed : by_moving, l, &interval);
    }
  }
}
#define NSVCD__CERTIFY_SLAB(i, j, separated, l, interval) \
  nsvcd__certify_slab(i, j, separated, l, interval)
#define NSVCD__CERTIFY_GROUPS(p, search, g, h, first, apart, by_fixed, by_moving) \
  nsvcd__certify_groups(p, search, g, h, first, apart, by_fixed, by_moving)
#else
#define NSVCD__CERTIFY_SLAB(i, j, separated, l, interval) \
  ((void)(i), (void)(j), (void)(separated), (void)(l), (void)(interval))
#define NSVCD__CERTIFY_GROUPS(p, search, g, h, first, apart, by_fixed, by_moving) ((void)0)
#endif

// The lanes of a slice among 16.
static inline uint32_t nsvcd__lanes_of_slice(uint32_t lanes, size_t l) {
  return lanes >> l & (((uint32_t)1 << NSVCD__SLICE) - 1);
}

// Lanes of `wanted` that are not separated: pairs of moving patches from the i-th on and patch j.
static inline uint32_t nsvcd__not_separated(size_t i, size_t j,
                                            const nsvcd__interval *interval,
                                            const nsvcd__v_separated *separated,
                                            uint32_t wanted) {
  const uint32_t apart = (separated->above | separated->below) & wanted;
  for (uint32_t k = apart; k; k &= k - 1) {
    const size_t l = nsvcd__low_bit(k);
    NSVCD__CERTIFY_SLAB(i + l, j, separated, l, interval);
  }
  return wanted & ~apart;
}

// Of the lanes `met` of moving group g in a segment, those that slabs do not part from resting
// patch j. c: the chords of the group's patches; reach: no point of the group is farther from the
// body's origin.
static uint32_t nsvcd__slabs_meet(const nsvcd__proof *p, const nsvcd__chords *c, size_t g,
                                  size_t j, const nsvcd__interval *interval, float radius,
                                  uint32_t met) {
  const nsvcd__slab fixed = nsvcd__slab_at(p->fixed.slabs, p->fixed.body->padded, j);
  const nsvcd__f3 centre = nsvcd__patch_centre(&p->fixed, j);
  const nsvcd__mat3 *from = &interval->start.rotation;
  const nsvcd__mat3 *to = &interval->end.rotation;
  uint32_t left = 0;
  nsvcd__v_approach a;
  a.fixed = nsvcd__v_slab_set(&fixed);
  a.at_start = nsvcd__v3_set(nsvcd__mat3_apply_transpose(from, fixed.normal));
  a.at_end = nsvcd__v3_set(nsvcd__mat3_apply_transpose(to, fixed.normal));
  a.scale = nsvcd__v_set(p->ask.motion->scale);
  a.interval = nsvcd__v_interval_set(interval);
  a.clearance = nsvcd__clearance(p);
  a.radius = radius;
  a.fixed_off = nsvcd__v_off(&a, a.fixed.normal);
  NSVCD__EACH_SLICE(l) {
    const size_t i = NSVCD__GROUP * g + l;
    uint32_t wanted = nsvcd__lanes_of_slice(met, l);
    if (!wanted) continue;
    a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
    a.chord = nsvcd__chords_travel(c, l);
    a.moving = nsvcd__v_slab_load(p->moving.slabs + i, p->moving.body->padded);
    nsvcd__v_separated separated = nsvcd__v_separate_by_fixed(&a);
    wanted = nsvcd__not_separated(i, j, interval, &separated, wanted);
    if (!wanted) continue;
    // rotations in a interval are times the scale
    const float half = 0.5f * p->ask.motion->per_scale;
    const nsvcd__mat3 middle = nsvcd__mat3_mix(half, to, 1, from);
    const nsvcd__mat3 half_turn = nsvcd__mat3_mix(half, to, -1, from);
    a.mean = nsvcd__vmat3_apply(nsvcd__vmat3_set(&middle), a.moving.normal);
    a.turned = nsvcd__vmat3_apply(nsvcd__vmat3_set(&half_turn), a.moving.normal);
    separated = nsvcd__v_separate_by_moving(&a);
    left |= nsvcd__not_separated(i, j, interval, &separated, wanted) << l;
  }
  return left;
}

// Clears the segments in which slabs part the moving group that is searched, whose chords are in
// search->group, from the resting ones that it meets: 16 segments at a time. The planes are those
// of single slabs, with all in lanes but the slabs.
static NSVCD__NOINLINE void nsvcd__separate_groups(const nsvcd__proof *p,
                                                   nsvcd__search *search) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const size_t next = search->order[search->step];
  const size_t g = search->moving_tile.groups[next];
  const nsvcd__slab own =
      nsvcd__slab_at(p->moving.group_slabs, nsvcd__group_slots(moving->padded), g);
  nsvcd__v_approach a;
  a.moving = nsvcd__v_slab_set(&own);
  a.scale = nsvcd__v_set(search->scale);
  a.clearance = nsvcd__clearance(p);
  a.radius = nsvcd__group_extent(moving, g);
  for (uint32_t waiting = search->waiting; waiting; waiting &= waiting - 1) {
    const size_t at = nsvcd__low_bit(waiting);
    const size_t h = search->fixed_tile.groups[at];
    const nsvcd__slab other =
        nsvcd__slab_at(p->fixed.group_slabs, nsvcd__group_slots(fixed->padded), h);
    const nsvcd__f3 centre = nsvcd__centre_of(nsvcd__groups_of(fixed), h);
    uint64_t *met = &nsvcd__nearby(search, next)[at];
    a.fixed = nsvcd__v_slab_set(&other);
    for (size_t first = 0; first < NSVCD__MAX_SEGMENTS; first += NSVCD__SLICE) {
      const uint32_t wanted = nsvcd__lanes_of_slice((uint32_t)(*met >> first & 0xffff), 0);
      nsvcd__segments *block = &search->blocks[first / NSVCD__LANES];
      const nsvcd__chords *c = &search->group[first / NSVCD__LANES];
      const size_t l = first % NSVCD__LANES;
      if (l == 0 && (*met >> first & 0xffff)) NSVCD__TALLY(tests, 1);
      if (!wanted) continue;
      const nsvcd__vmat3 rotation = nsvcd__vmat3_load(block->rotation, l);
      const nsvcd__vmat3 turn = nsvcd__vmat3_load(block->turned, l);
      const nsvcd__v half = nsvcd__v_set(0.5f / search->scale);
      const nsvcd__v whole = nsvcd__v_set(1 / search->scale);
      const nsvcd__v3 n = a.fixed.normal;
      const nsvcd__v3 m = a.moving.normal;
      a.interval = nsvcd__v_interval_load(block, l);
      a.fixed_off = nsvcd__v_off(&a, n);
      a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
      a.chord = nsvcd__chords_travel(c, l);
      a.at_start = nsvcd__vmat3_apply_transpose(rotation, n);
      a.at_end = nsvcd__v3_add(a.at_start, nsvcd__vmat3_apply_transpose(turn, n));
      a.turned = nsvcd__v3_scale(nsvcd__vmat3_apply(turn, m), half);
      a.mean = nsvcd__v3_fma(whole, nsvcd__vmat3_apply(rotation, m), a.turned);
      const nsvcd__v_separated by_fixed = nsvcd__v_separate_by_fixed(&a);
      const nsvcd__v_separated by_moving = nsvcd__v_separate_by_moving(&a);
      const uint32_t either =
          by_fixed.below | by_fixed.above | by_moving.below | by_moving.above;
      *met &= ~((uint64_t)(either & wanted) << first);
      NSVCD__CERTIFY_GROUPS(p, search, g, h, first, either & wanted, &by_fixed, &by_moving);
    }
    if (!*met) search->waiting &= ~((uint32_t)1 << at);
  }
}
#endif  // NSVCD_NO_PROOF
