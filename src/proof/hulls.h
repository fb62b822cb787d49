// In: a patch pair and a interval. Out: is there a plane between the two hulls, over all of the
// interval?
#pragma once
#include "motion_bounds.h"

#ifndef NSVCD_NO_PROOF
// Vertices first .. first + 15 of a patch, of which `count` are wanted: the slice of them that
// begins with lane l. The last one wanted is repeated in the lanes that are left.
NSVCD__INLINE nsvcd__v3 nsvcd__hull_vertices(const nsvcd__geometry *f, size_t patch,
                                             size_t first, size_t count, size_t l) {
  static const float lane[NSVCD__LANES] = {0, 1, 2,  3,  4,  5,  6,  7,
                                           8, 9, 10, 11, 12, 13, 14, 15};
  const nsvcd__vertices all = nsvcd__vertices_of(f, patch);
  const int16_t *x = all.x + first;
  const int16_t *y = all.y + first;
  const int16_t *z = all.z + first;
  nsvcd__v3 q;
  q.x = nsvcd__v_load_int16(x + l);
  q.y = nsvcd__v_load_int16(y + l);
  q.z = nsvcd__v_load_int16(z + l);
  if (count < l + NSVCD__SLICE) {
    const size_t last = count - 1;
    const nsvcd__v end = nsvcd__v_set((float)last);
    const nsvcd__v index = nsvcd__v_load(lane + l);
    q.x = nsvcd__v_pick(index, end, q.x, nsvcd__v_set((float)x[last]));
    q.y = nsvcd__v_pick(index, end, q.y, nsvcd__v_set((float)y[last]));
    q.z = nsvcd__v_pick(index, end, q.z, nsvcd__v_set((float)z[last]));
  }
  const nsvcd__v step = nsvcd__v_set(f->steps[patch]);
  return nsvcd__v3_fma(step, q, nsvcd__v3_set(nsvcd__patch_centre(f, patch)));
}

// A slice of a patch's hull, the last vertex repeated; its body's frame and units.
NSVCD__INLINE nsvcd__v3 nsvcd__hull_of(const nsvcd__geometry *f, size_t patch, size_t l) {
  return nsvcd__hull_vertices(f, patch, 0, f->hull_counts[patch], l);
}

// Posed hulls along a direction: how far the moving one, at both ends of the interval, stays ahead
// of the resting one, and the difference of the two vertices that say so.
typedef struct nsvcd__support {
  float gap;
  nsvcd__f3 difference;
} nsvcd__support;

// The lesser of the least number so far and that of a slice. What is no number stays none, and
// parts nothing.
static inline float nsvcd__least_of(float least, float of_slice) {
  return least < of_slice || least != least ? least : of_slice;
}

NSVCD__INLINE nsvcd__support nsvcd__support_along(nsvcd__proof *p, nsvcd__f3 normal) {
  // the moving side's lower heights, and the resting side's, negated
  float either[NSVCD__LANES], rest[NSVCD__LANES];
  float lowest = HUGE_VALF;
  float lowest_rest = HUGE_VALF;
  uint32_t starts = 0;
  uint32_t least = 0;
  uint32_t least_rest = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 n = nsvcd__v3_set(normal);
    const nsvcd__v at_start = nsvcd__v3_dot(n, nsvcd__v3_load(p->hull_start, l));
    const nsvcd__v at_end = nsvcd__v3_dot(n, nsvcd__v3_load(p->hull_end, l));
    const nsvcd__v rests = nsvcd__v3_dot(n, nsvcd__v3_load(p->hull_rest, l));
    const nsvcd__v at_rest = nsvcd__v_negate(rests);
    const nsvcd__v at_either = nsvcd__v_min(at_start, at_end);
    nsvcd__v_store(either + l, at_either);
    nsvcd__v_store(rest + l, at_rest);
    lowest = nsvcd__least_of(lowest, nsvcd__v_least(at_either));
    lowest_rest = nsvcd__least_of(lowest_rest, nsvcd__v_least(at_rest));
    starts |= nsvcd__v_le(at_start, at_end) << l;
  }
  NSVCD__EACH_SLICE(l) {
    least |= nsvcd__v_le(nsvcd__v_load(either + l), nsvcd__v_set(lowest)) << l;
    least_rest |= nsvcd__v_le(nsvcd__v_load(rest + l), nsvcd__v_set(lowest_rest)) << l;
  }
  const float highest = -lowest_rest;
  // Were a number not one, no lane would compare: then the last one.
  const size_t a = nsvcd__low_bit(least | 0x8000);
  const size_t b = nsvcd__low_bit(least_rest | 0x8000);
  const int is_start = (starts >> a & 1) != 0;
  const nsvcd__f3 moving = nsvcd__lane_of(is_start ? p->hull_start : p->hull_end, a);
  const nsvcd__support out = {lowest - highest,
                              nsvcd__f3_sub(moving, nsvcd__lane_of(p->hull_rest, b))};
  return out;
}

// a or -a, on the side of b.
static nsvcd__f3 nsvcd__f3_towards(nsvcd__f3 a, nsvcd__f3 b) {
  return nsvcd__f3_scale(a, nsvcd__f3_dot(a, b) < 0 ? -1.0f : 1.0f);
}

static float nsvcd__clamp01(float x) {
  return x < 0 ? 0 : x < 1 ? x : 1;
}

static void nsvcd__remember_plane(nsvcd__memo *memo, nsvcd__f3 normal) {
  // heights are of another query
  if (memo->plane == 0) {
    memset(memo->heights, 0, sizeof memo->heights);
    memset(memo->rest_heights, 0, sizeof memo->rest_heights);
  }
  memo->held = normal;
  memo->plane++;
}

// Is there a plane between two patches over the whole interval? A direction is tried by the gap
// that it finds between the hulls, which must be more than the margin and what the interval
// deviates. First guesses: the last plane that held, the slabs' normals, and the line of centres.
// Then Gilbert's iteration (1966) from there towards the point nearest to 0 of the differences of
// the two hulls. p->memo.held is the one that held.
#define NSVCD__GUESSES 4
static NSVCD__NOINLINE int nsvcd__hulls_are_apart(nsvcd__proof *p, size_t i, size_t j,
                                                  const nsvcd__interval *interval) {
  const float margins = p->ask.motion->scale * p->moving.margins[i] + p->fixed.margins[j];
  const float margin = margins + interval->rounding + nsvcd__clearance(p);
  const nsvcd__arm arm = nsvcd__patch_arm(&p->moving, i, interval);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 moving = nsvcd__hull_of(&p->moving, i, l);
    nsvcd__v3_store(p->hull_start, l, nsvcd__v3_transform(&interval->start, moving));
    nsvcd__v3_store(p->hull_end, l, nsvcd__v3_transform(&interval->end, moving));
    nsvcd__v3_store(p->hull_rest, l, nsvcd__hull_of(&p->fixed, j, l));
  }
  const nsvcd__slab moving = nsvcd__slab_at(p->moving.slabs, p->moving.body->padded, i);
  const nsvcd__slab fixed = nsvcd__slab_at(p->fixed.slabs, p->fixed.body->padded, j);
  const nsvcd__f3 centre = nsvcd__patch_centre(&p->moving, i);
  const nsvcd__f3 start = nsvcd__f3_transform(&interval->start, centre);
  const nsvcd__f3 end = nsvcd__f3_transform(&interval->end, centre);
  const nsvcd__f3 middle = nsvcd__f3_scale(nsvcd__f3_add(start, end), 0.5f);
  const nsvcd__f3 line = nsvcd__f3_sub(middle, nsvcd__patch_centre(&p->fixed, j));
  const nsvcd__f3 extreme = nsvcd__f3_transform(&interval->start, moving.normal);
  const nsvcd__f3 turned = nsvcd__f3_sub(extreme, interval->start.position);
  const nsvcd__f3 guesses[NSVCD__GUESSES] = {p->memo.held,
                                             nsvcd__f3_towards(fixed.normal, line),
                                             nsvcd__f3_towards(turned, line), line};
  nsvcd__f3 nearest = {0, 0, 0};
  p->work++;
  NSVCD__TALLY(planes, 1);
  for (size_t step = 0; step < NSVCD__GUESSES + NSVCD__PLANE_STEPS; step++) {
    const nsvcd__f3 normal = step < NSVCD__GUESSES ? guesses[step] : nearest;
    const nsvcd__support found = nsvcd__support_along(p, normal);
    const float length = nsvcd__f3_length(normal);
    if (found.gap > 0 &&
        found.gap > margin * length + nsvcd__deviation_of(interval, normal, arm)) {
      nsvcd__remember_plane(&p->memo, normal);
      return 1;
    }
    if (step + 1 < NSVCD__GUESSES) continue;
    const nsvcd__f3 toward = nsvcd__f3_sub(found.difference, nearest);
    const float square = nsvcd__f3_dot(toward, toward);
    const float fraction =
        square > 0 ? nsvcd__clamp01(-nsvcd__f3_dot(nearest, toward) / square) : 0;
    const nsvcd__f3 nearer = nsvcd__f3_add(nearest, nsvcd__f3_scale(toward, fraction));
    nearest = step < NSVCD__GUESSES ? found.difference : nearer;
    // these hulls come this near
    if (nsvcd__f3_dot(nearest, nearest) <= margin * margin) return 0;
  }
  return 0;
}
#endif  // NSVCD_NO_PROOF
