// In: a patch pair and an interval. Out: is there a plane between the two hulls over all of the
// interval?
#pragma once
#include "../lanes/turns.h"
#include "../triangles/motion_bounds.h"

#ifndef NSVCD_NO_PROOF
// A slice, from lane l on, of a patch's hull, in its body's frame and units. Lanes without a vertex
// repeat the last one.
NSVCD__INLINE nsvcd__v3 nsvcd__hull_of(const nsvcd__geometry *f, size_t patch, size_t l) {
  static const float lane[NSVCD__LANES] = {0, 1, 2,  3,  4,  5,  6,  7,
                                           8, 9, 10, 11, 12, 13, 14, 15};
  const nsvcd__vertices all = nsvcd__vertices_of(f, patch);
  const size_t count = f->hull_counts[patch];
  nsvcd__v3 q;
  q.x = nsvcd__v_load_int16(all.x + l);
  q.y = nsvcd__v_load_int16(all.y + l);
  q.z = nsvcd__v_load_int16(all.z + l);
  if (count < l + NSVCD__SLICE) {
    const size_t last = count - 1;
    const nsvcd__v end = nsvcd__v_set((float)last);
    const nsvcd__v index = nsvcd__v_load(lane + l);
    q.x = nsvcd__v_pick(index, end, q.x, nsvcd__v_set((float)all.x[last]));
    q.y = nsvcd__v_pick(index, end, q.y, nsvcd__v_set((float)all.y[last]));
    q.z = nsvcd__v_pick(index, end, q.z, nsvcd__v_set((float)all.z[last]));
  }
  const nsvcd__v step = nsvcd__v_set(f->steps[patch]);
  return nsvcd__v3_fma(step, q, nsvcd__v3_set(nsvcd__patch_centre(f, patch)));
}

// The least of a number and a slice. A NaN stays: it separates nothing.
NSVCD__INLINE float nsvcd__least_of(float least, nsvcd__v slice) {
  const float other = nsvcd__v_least(slice);
  return least < other || least != least ? least : other;
}

// The greatest of a number and a slice. A NaN stays.
NSVCD__INLINE float nsvcd__greatest_of(float greatest, nsvcd__v slice) {
  return -nsvcd__least_of(-greatest, nsvcd__v_negate(slice));
}

// The gap between two posed hulls along a direction, the moving one at both ends of the interval,
// and the difference of the two vertices that bound it.
typedef struct nsvcd__support {
  float gap;
  nsvcd__f3 difference;
} nsvcd__support;

NSVCD__INLINE nsvcd__support nsvcd__support_along(nsvcd__solver *w, nsvcd__f3 normal) {
  float moving[NSVCD__LANES], fixed[NSVCD__LANES];  // heights
  float lowest = HUGE_VALF;
  float highest = -HUGE_VALF;
  uint32_t starts = 0;  // lanes that are lower at the start
  uint32_t low = 0;
  uint32_t high = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 n = nsvcd__v3_set(normal);
    const nsvcd__v at_start = nsvcd__v3_dot(n, nsvcd__v3_load(w->hull_start, l));
    const nsvcd__v at_end = nsvcd__v3_dot(n, nsvcd__v3_load(w->hull_end, l));
    const nsvcd__v height = nsvcd__v3_dot(n, nsvcd__v3_load(w->hull_fixed, l));
    const nsvcd__v at_either = nsvcd__v_min(at_start, at_end);
    nsvcd__v_store(moving + l, at_either);
    nsvcd__v_store(fixed + l, height);
    lowest = nsvcd__least_of(lowest, at_either);
    highest = nsvcd__greatest_of(highest, height);
    starts |= nsvcd__v_le(at_start, at_end) << l;
  }
  NSVCD__EACH_SLICE(l) {
    low |= nsvcd__v_le(nsvcd__v_load(moving + l), nsvcd__v_set(lowest)) << l;
    high |= nsvcd__v_le(nsvcd__v_set(highest), nsvcd__v_load(fixed + l)) << l;
  }
  // a NaN compares with no lane: then the last one
  const size_t a = nsvcd__low_bit(low | 0x8000);
  const size_t b = nsvcd__low_bit(high | 0x8000);
  const int is_start = (starts >> a & 1) != 0;
  const nsvcd__f3 vertex = nsvcd__lane_of(is_start ? w->hull_start : w->hull_end, a);
  const nsvcd__f3 other = nsvcd__lane_of(w->hull_fixed, b);
  const nsvcd__support out = {lowest - highest, nsvcd__f3_sub(vertex, other)};
  return out;
}

// a or -a, on the side of b.
static nsvcd__f3 nsvcd__f3_towards(nsvcd__f3 a, nsvcd__f3 b) {
  return nsvcd__f3_scale(a, nsvcd__f3_dot(a, b) < 0 ? -1.0f : 1.0f);
}

// Remembers a plane that held. No heights are known over the first one.
static void nsvcd__hold_plane(nsvcd__memo *memo, nsvcd__f3 normal) {
  if (!memo->plane) {
    memset(memo->heights, 0, sizeof memo->heights);
    memset(memo->fixed_heights, 0, sizeof memo->fixed_heights);
  }
  memo->held = normal;
  memo->plane++;
}

// The point nearest to 0 of a chord.
static nsvcd__f3 nsvcd__f3_nearest(nsvcd__f3 start, nsvcd__f3 travel) {
  const float square = nsvcd__f3_dot(travel, travel);
  const float fraction = square > 0 ? -nsvcd__f3_dot(start, travel) / square : 0;
  const float clamped = fraction > 0 ? fminf(fraction, 1) : 0;
  return nsvcd__f3_add(start, nsvcd__f3_scale(travel, clamped));
}

// Is there a plane between two patches over the whole interval? A direction separates them if the
// gap between the hulls along it is more than the margin and the deviation. First guesses: the last
// plane that held, the slabs' normals, the line of centres. Then Gilbert's iteration (1966) from
// there towards the point nearest to 0 of the difference of the two hulls.
// Remembers the plane that holds.
#define NSVCD__GUESSES 4
static NSVCD__NOINLINE int nsvcd__hulls_are_apart(nsvcd__solver *w, size_t i, size_t j,
                                                  const nsvcd__interval *over) {
  nsvcd__proof *p = &w->p;
  const nsvcd__geometry *f = &p->moving;
  const nsvcd__geometry *g = &p->fixed;
  const float margins = p->arcs.motion->scale * f->margins[i] + g->margins[j];
  const float margin = margins + over->rounding + nsvcd__clearance(&p->goal);
  const nsvcd__arm arm = nsvcd__patch_arm(f, i, over);
  const nsvcd__transform *start = &over->start;
  const nsvcd__transform *end = &over->end;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 hull = nsvcd__hull_of(f, i, l);
    nsvcd__v3_store(w->hull_start, l, nsvcd__v3_transform(start, hull));
    nsvcd__v3_store(w->hull_end, l, nsvcd__v3_transform(end, hull));
    nsvcd__v3_store(w->hull_fixed, l, nsvcd__hull_of(g, j, l));
  }
  const nsvcd__slab moving = nsvcd__slab_at(f->slabs, f->body->padded, i);
  const nsvcd__slab fixed = nsvcd__slab_at(g->slabs, g->body->padded, j);
  const nsvcd__f3 centre = nsvcd__patch_centre(f, i);
  // between the centres when they are nearest
  const nsvcd__f3 from =
      nsvcd__f3_sub(nsvcd__f3_transform(start, centre), nsvcd__patch_centre(g, j));
  const nsvcd__f3 to =
      nsvcd__f3_sub(nsvcd__f3_transform(end, centre), nsvcd__patch_centre(g, j));
  const nsvcd__f3 line = nsvcd__f3_nearest(from, nsvcd__f3_sub(to, from));
  const nsvcd__f3 turned = nsvcd__mat3_apply(&start->rotation, moving.normal);
  const nsvcd__f3 guesses[NSVCD__GUESSES] = {w->memo.held,
                                             nsvcd__f3_towards(fixed.normal, line),
                                             nsvcd__f3_towards(turned, line), line};
  nsvcd__f3 nearest = {0, 0, 0};
  p->work++;
  // where all that is near is listed, most hulls are near, and their triangles cost no more
  // nor do those that a point meets
  const int is_brief = p->goal.collects == NSVCD__LISTING || f->hull_counts[i] == 1;
  const size_t steps = is_brief ? 0 : NSVCD__PLANE_STEPS;
  for (size_t step = 0; step < NSVCD__GUESSES + steps; step++) {
    const nsvcd__f3 normal = step < NSVCD__GUESSES ? guesses[step] : nearest;
    const nsvcd__support found = nsvcd__support_along(w, normal);
    const float length = nsvcd__f3_norm(normal);
    if (found.gap > 0 &&
        found.gap > margin * length + nsvcd__deviation_of(over, normal, arm)) {
      nsvcd__hold_plane(&w->memo, normal);
      return 1;
    }
    if (step + 1 < NSVCD__GUESSES) continue;
    const nsvcd__f3 toward = nsvcd__f3_sub(found.difference, nearest);
    const nsvcd__f3 nearer = nsvcd__f3_nearest(nearest, toward);
    nearest = step < NSVCD__GUESSES ? found.difference : nearer;
    // the hulls come this near
    if (nsvcd__f3_dot(nearest, nearest) <= margin * margin) return 0;
  }
  return 0;
}

// Does the plane that held last separate a patch pair over its segment, moved along its normal? If
// it does, the pair's neighbours ask for the same heights: so these are remembered, of a moving
// patch in a segment the least, less all margins, and of a fixed one the greatest.
static int nsvcd__held_again(nsvcd__solver *w, const nsvcd__search *q,
                             const nsvcd__patch_pair *patches) {
  nsvcd__proof *p = &w->p;
  const size_t i = patches->moving;
  const size_t j = patches->fixed;
  const size_t s = patches->segment;
  const nsvcd__geometry *f = &p->moving;
  const nsvcd__geometry *g = &p->fixed;
  nsvcd__memo *memo = &w->memo;
  if (!memo->plane) return 0;
  const nsvcd__interval *over = nsvcd__segment_interval(w, q, s);
  const nsvcd__f3 n = memo->held;
  const float length = nsvcd__f3_norm(n);
  const uint32_t key = (uint32_t)(i * NSVCD__MAX_SEGMENTS + s);
  nsvcd__height *above =
      &memo->heights[(NSVCD__GROUP * s + i % NSVCD__GROUP) % NSVCD__HEIGHTS];
  nsvcd__height *below = &memo->fixed_heights[j % NSVCD__FIXED_HEIGHTS];
  if (above->plane != memo->plane || above->key != key) {
    float lowest = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 hull = nsvcd__hull_of(f, i, l);
      const nsvcd__v3 normal = nsvcd__v3_set(n);
      const nsvcd__v at_start = nsvcd__v3_dot(normal, nsvcd__v3_transform(&over->start, hull));
      const nsvcd__v at_end = nsvcd__v3_dot(normal, nsvcd__v3_transform(&over->end, hull));
      lowest = nsvcd__least_of(lowest, nsvcd__v_min(at_start, at_end));
    }
    const float margin = (p->arcs.motion->scale * f->margins[i] + over->rounding) * length;
    above->plane = memo->plane;
    above->key = key;
    above->height =
        lowest - margin - nsvcd__deviation_of(over, n, nsvcd__patch_arm(f, i, over));
  }
  if (below->plane != memo->plane || below->key != j) {
    float highest = -HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v height = nsvcd__v3_dot(nsvcd__v3_set(n), nsvcd__hull_of(g, j, l));
      highest = nsvcd__greatest_of(highest, height);
    }
    below->plane = memo->plane;
    below->key = (uint32_t)j;
    below->height = g->margins[j] * length + highest;
  }
  return above->height > below->height + nsvcd__clearance(&p->goal) * length;
}
#endif  // NSVCD_NO_PROOF
