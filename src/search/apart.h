// In: 16 moving patches whose balls meet that of a resting one in a segment. Out: those that no
// plane separates from it all the time, by the hulls of their extremes.
//
// Planes are tried along the resting patch's normal, the moving patches', both together, the lines
// between the centres, and the last few that separated others of the same query: what stands on a
// table is separated from all of it by one plane, whole groups at a time. The extremes go on
// chords, as centres do, and what points deviate from theirs is allowed for. But extremes are not
// all of a patch, so that this is no proof: where a greater recall is asked for, patches swell
// before.
#pragma once
#include "../motion/segments.h"

#ifndef NSVCD_NO_NETWORK
// A resting patch: its extremes, from its centre, metres; and the mean normal.
typedef struct nsvcd__resting {
  nsvcd__f3 centre;
  float radius;
  nsvcd__f3 extremes[NSVCD__EXTREMES];
  nsvcd__f3 normal;
} nsvcd__resting;

static nsvcd__resting nsvcd__resting_of(const nsvcd_body *body, size_t j) {
  const int8_t *extremes = nsvcd__group_extremes(body, j / NSVCD__GROUP) + j % NSVCD__GROUP;
  nsvcd__resting out;
  const nsvcd__sphere ball = nsvcd__sphere_of(nsvcd__body_patches(body), j);
  const float step = ball.radius / 127;
  out.centre = ball.centre;
  out.radius = ball.radius;
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__GROUP) {
    const nsvcd__f3 extreme =
        nsvcd__f3_of(extremes[0], extremes[NSVCD__GROUP], extremes[2 * NSVCD__GROUP]);
    out.extremes[k] = nsvcd__f3_scale(extreme, step);
  }
  const nsvcd__f3 area = nsvcd__f3_get(nsvcd__body_areas(body) + j, body->padded);
  const float length = nsvcd__f3_length(area);
  out.normal = nsvcd__f3_scale(area, length > 0 ? 1 / length : 0);
  return out;
}

// A slice of moving patches, over a segment.
typedef struct nsvcd__passing {
  // (TIPS, 3, 16) and lane l: of the moving group
  const int8_t *extremes;
  // steps of the extremes, in the body's units
  nsvcd__v step;
  // from the resting centre to the moving one, and its way
  nsvcd__v3 from, travel;
  // at the start and at the end, times the scale
  nsvcd__vmat3 start, end;
  // what points deviate from their chords, and patches swell
  nsvcd__v deviation;
} nsvcd__passing;

// A slice of extremes (TIPS, 3, 16) along u.
NSVCD__INLINE void nsvcd__extremes_along(const int8_t *extremes, nsvcd__v3 u, nsvcd__v *low,
                                         nsvcd__v *high) {
  *low = nsvcd__v_set(1e30f);
  *high = nsvcd__v_set(-1e30f);
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__LANES) {
    const nsvcd__v3 q = nsvcd__v3_load_int8(extremes, NSVCD__LANES);
    const nsvcd__v along = nsvcd__v3_dot(q, u);
    *low = nsvcd__v_min(*low, along);
    *high = nsvcd__v_max(*high, along);
  }
}

// Lanes in which a plane across u parts both, on either side.
NSVCD__INLINE uint32_t nsvcd__separated_along(const nsvcd__passing *p,
                                              const nsvcd__resting *rest, nsvcd__v3 u) {
  const nsvcd__v3 at_start = nsvcd__vmat3_apply_transpose(p->start, u);
  const nsvcd__v3 at_end = nsvcd__vmat3_apply_transpose(p->end, u);
  const nsvcd__v height = nsvcd__v3_dot(u, p->from);
  const nsvcd__v height_end = nsvcd__v3_dot_add(u, p->travel, height);
  nsvcd__v low, high, low_end, high_end;
  nsvcd__v below = nsvcd__v_set(1e30f);
  nsvcd__v above = nsvcd__v_set(-1e30f);
  nsvcd__extremes_along(p->extremes, at_start, &low, &high);
  nsvcd__extremes_along(p->extremes, at_end, &low_end, &high_end);
  for (size_t k = 0; k < NSVCD__EXTREMES; k++) {
    const nsvcd__v along = nsvcd__v3_dot(nsvcd__v3_set(rest->extremes[k]), u);
    below = nsvcd__v_min(below, along);
    above = nsvcd__v_max(above, along);
  }
  low = nsvcd__v_fma(p->step, low, height);
  low_end = nsvcd__v_fma(p->step, low_end, height_end);
  high = nsvcd__v_fma(p->step, high, height);
  high_end = nsvcd__v_fma(p->step, high_end, height_end);
  const nsvcd__v least = nsvcd__v_sub(nsvcd__v_min(low, low_end), p->deviation);
  const nsvcd__v most = nsvcd__v_add(nsvcd__v_max(high, high_end), p->deviation);
  return nsvcd__v_lt(above, least) | nsvcd__v_lt(most, below);
}

// ---- planes that separated others

// What 16 patches reach along a plane's normal.
typedef struct nsvcd__ranges {
  float low[NSVCD__LANES], high[NSVCD__LANES];
} nsvcd__ranges;

// planes that are remembered
#define NSVCD__PLANES 2

// Planes that separated others, and a pair of groups along them: the moving one in one segment.
typedef struct nsvcd__plane_cache {
  // normals; how many were found, of which the last ones are kept; the one that separated last
  nsvcd__f3 planes[NSVCD__PLANES];
  uint32_t found, best;
  float inflate;  // of patches, shares of their radii
  int unasked;    // balls that meet are all that counts
  nsvcd__ranges moving[NSVCD__PLANES], resting[NSVCD__PLANES];
  // bits of planes
  uint16_t moving_known, resting_known;
} nsvcd__plane_cache;

// Begins the search of a motion.
static void nsvcd__plane_cache_begin(nsvcd__search *search, float inflate) {
  search->cache->found = search->cache->best = 0;
  search->cache->inflate = inflate;
  // patches whose balls meet are then no farther apart than that
  search->cache->unasked = inflate >= 1;
  search->balls_met = 0;
}

// share: of their radii, by which they swell.
static void nsvcd__resting_ranges(const nsvcd_body *body, size_t h, nsvcd__f3 normal,
                                  float fraction, nsvcd__ranges *out) {
  const nsvcd__spheres patches =
      nsvcd__spheres_from(nsvcd__body_patches(body), NSVCD__GROUP * h);
  const nsvcd__v3 u = nsvcd__v3_set(normal);
  NSVCD__EACH_SLICE(l) {
    nsvcd__v low;
    nsvcd__v high;
    const nsvcd__v step = nsvcd__v_scale(nsvcd__v_load(patches.r + l), 1.0f / 127);
    const nsvcd__v height = nsvcd__v3_dot(u, nsvcd__v3_centres(patches, l));
    nsvcd__extremes_along(nsvcd__group_extremes(body, h) + l, u, &low, &high);
    const nsvcd__v inflate = nsvcd__v_scale(step, 127 * fraction);
    nsvcd__v_store(out->low + l, nsvcd__v_sub(nsvcd__v_fma(step, low, height), inflate));
    nsvcd__v_store(out->high + l, nsvcd__v_add(nsvcd__v_fma(step, high, height), inflate));
  }
}

// What the points of the members that are posed deviate from their chords in segment s.
static float nsvcd__segment_deviation(const nsvcd__search *search, size_t s) {
  const nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  return block->margin[s % NSVCD__LANES] + block->bend[s % NSVCD__LANES] * search->extent;
}

// Of moving group g in segment s, with what points deviate.
static void nsvcd__moving_ranges(const nsvcd__search *search, size_t g, size_t s,
                                 float deviation, nsvcd__f3 normal, nsvcd__ranges *out) {
  nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  const nsvcd__chords *c = &search->members[s];
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, s % NSVCD__LANES);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, s % NSVCD__LANES);
  const nsvcd__f3 at_start = nsvcd__mat3_apply_transpose(&start, normal);
  const nsvcd__f3 by = nsvcd__mat3_apply_transpose(&turned, normal);
  const nsvcd__v3 u = nsvcd__v3_set(normal);
  const float *radii = nsvcd__body_r(search->moving) + NSVCD__GROUP * g;
  const int8_t *extremes = nsvcd__group_extremes(search->moving, g);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v step = nsvcd__v_scale(nsvcd__v_load(radii + l), 1.0f / 127);
    const nsvcd__v height = nsvcd__v3_dot(u, nsvcd__chords_start(c, l));
    const nsvcd__v height_end = nsvcd__v3_dot_add(u, nsvcd__chords_travel(c, l), height);
    nsvcd__v low, high, low_end, high_end;
    nsvcd__extremes_along(extremes + l, nsvcd__v3_set(at_start), &low, &high);
    nsvcd__extremes_along(extremes + l, nsvcd__v3_set(nsvcd__f3_add(at_start, by)), &low_end,
                          &high_end);
    low = nsvcd__v_fma(step, low, height);
    high = nsvcd__v_fma(step, high, height);
    low = nsvcd__v_min(low, nsvcd__v_fma(step, low_end, height_end));
    high = nsvcd__v_max(high, nsvcd__v_fma(step, high_end, height_end));
    const nsvcd__v inflate =
        nsvcd__v_scale(step, 127 * search->scale * search->cache->inflate);
    const nsvcd__v off = nsvcd__v_plus(inflate, deviation);
    nsvcd__v_store(out->low + l, nsvcd__v_sub(low, off));
    nsvcd__v_store(out->high + l, nsvcd__v_add(high, off));
  }
}

// Fills in the ranges along plane n of group h of the fixed body.
static void nsvcd__resting_know(const nsvcd__search *search, size_t h, size_t n) {
  nsvcd__plane_cache *cache = search->cache;
  if (cache->resting_known >> n & 1) return;
  nsvcd__resting_ranges(search->fixed, h, cache->planes[n], cache->inflate,
                        &cache->resting[n]);
  cache->resting_known = (uint16_t)(cache->resting_known | 1u << n);
}

// The same, and those of moving group g in segment s.
static void nsvcd__plane_cache_knows(const nsvcd__search *search, size_t g, size_t s, size_t h,
                                     size_t n, float deviation) {
  nsvcd__plane_cache *cache = search->cache;
  const nsvcd__f3 normal = cache->planes[n];
  nsvcd__resting_know(search, h, n);
  if (!(cache->moving_known >> n & 1))
    nsvcd__moving_ranges(search, g, s, deviation, normal, &cache->moving[n]);
  cache->moving_known = (uint16_t)(cache->moving_known | 1u << n);
}

static size_t nsvcd__planes_known(const nsvcd__search *search) {
  const size_t found = search->cache->found;
  return found < NSVCD__PLANES ? found : NSVCD__PLANES;
}

// The least of all lanes, after a sign.
static float nsvcd__least_lane(const float *lanes, float sign) {
  nsvcd__v least = nsvcd__v_set(1e30f);
  NSVCD__EACH_SLICE(l)
  least = nsvcd__v_min(least, nsvcd__v_scale(nsvcd__v_load(lanes + l), sign));
  return nsvcd__v_least(least);
}

// Of the segments `wanted`, those in which the plane that separated last does not separate the ball
// of a moving group, whose chords these are, from all of group h of the fixed body.
static uint64_t nsvcd__unparted_segments(const nsvcd__search *search, size_t h,
                                         uint64_t wanted) {
  nsvcd__plane_cache *cache = search->cache;
  const size_t n = cache->best;
  uint64_t separated = 0;
  if (n >= nsvcd__planes_known(search)) return wanted;
  nsvcd__resting_know(search, h, n);
  const nsvcd__ranges *resting = &cache->resting[n];
  const nsvcd__v below = nsvcd__v_set(nsvcd__least_lane(resting->low, 1));
  const nsvcd__v above = nsvcd__v_set(-nsvcd__least_lane(resting->high, -1));
  const nsvcd__v3 u = nsvcd__v3_set(cache->planes[n]);
  for (size_t s = 0; s < search->segments; s += NSVCD__LANES) {
    const nsvcd__chords *c = &search->group[s / NSVCD__LANES];
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v start = nsvcd__v3_dot(u, nsvcd__chords_start(c, l));
      const nsvcd__v end = nsvcd__v3_dot_add(u, nsvcd__chords_travel(c, l), start);
      const nsvcd__v radius = nsvcd__v_scale(nsvcd__v_load(c->radius + l), 1 + cache->inflate);
      const nsvcd__v low = nsvcd__v_sub(nsvcd__v_min(start, end), radius);
      const nsvcd__v high = nsvcd__v_add(nsvcd__v_max(start, end), radius);
      const uint32_t here = nsvcd__v_lt(above, low) | nsvcd__v_lt(high, below);
      separated |= (uint64_t)here << (s + l);
    }
  }
  return wanted & ~separated;
}

// Of the members `bits` of group h of the fixed body, those that the same plane does not separate
// from all of moving group g, in segment s.
static uint32_t nsvcd__unparted_members(const nsvcd__search *search, size_t g, size_t s,
                                        size_t h, float deviation, uint32_t bits) {
  nsvcd__plane_cache *cache = search->cache;
  const size_t n = cache->best;
  if (n >= nsvcd__planes_known(search)) return bits;
  nsvcd__plane_cache_knows(search, g, s, h, n, deviation);
  const nsvcd__ranges *resting = &cache->resting[n];
  const nsvcd__v low = nsvcd__v_set(nsvcd__least_lane(cache->moving[n].low, 1));
  const nsvcd__v high = nsvcd__v_set(-nsvcd__least_lane(cache->moving[n].high, -1));
  NSVCD__EACH_SLICE(l) {
    bits &= ~(nsvcd__v_lt(high, nsvcd__v_load(resting->low + l)) << l);
    bits &= ~(nsvcd__v_lt(nsvcd__v_load(resting->high + l), low) << l);
  }
  return bits;
}

// Of the lanes `met` of moving group g in segment s, those that no plane remembered parts from
// member k of group h of the fixed body.
static uint32_t nsvcd__not_separated_again(nsvcd__search *search, size_t g, size_t s, size_t h,
                                           size_t k, float deviation, uint32_t met) {
  nsvcd__plane_cache *cache = search->cache;
  const size_t planes = nsvcd__planes_known(search);
  for (size_t m = 0; m < planes && met; m++) {
    // the one that separated last, first
    const size_t n = (cache->best + m) % planes;
    nsvcd__plane_cache_knows(search, g, s, h, n, deviation);
    const nsvcd__ranges *moving = &cache->moving[n];
    const nsvcd__v low = nsvcd__v_set(cache->resting[n].low[k]);
    const nsvcd__v high = nsvcd__v_set(cache->resting[n].high[k]);
    uint32_t separated = 0;
    NSVCD__EACH_SLICE(l) {
      separated |= nsvcd__v_lt(high, nsvcd__v_load(moving->low + l)) << l;
      separated |= nsvcd__v_lt(nsvcd__v_load(moving->high + l), low) << l;
    }
    if (met & separated) cache->best = (uint32_t)n;
    met &= ~separated;
  }
  return met;
}

// ---- planes of their own

enum {
  NSVCD__ALONG_RESTING,  // normal
  NSVCD__ALONG_MOVING,   // normals
  NSVCD__ALONG_LINE,     // between the centres
  NSVCD__ALONG_BOTH,     // normals, from one to the other
  NSVCD__DIRECTIONS
};

// Fills in how the moving body is turned in segment s.
static NSVCD__NOINLINE void nsvcd__passing_turns(const nsvcd__search *search, size_t s,
                                                 nsvcd__passing *p) {
  nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, s % NSVCD__LANES);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, s % NSVCD__LANES);
  const nsvcd__mat3 end = nsvcd__mat3_mix(1, &start, 1, &turned);
  p->start = nsvcd__vmat3_set(&start);
  p->end = nsvcd__vmat3_set(&end);
}

// Of the lanes `met` of moving group g in segment s, those that no plane of their own parts from a
// patch j of the fixed body. A plane that does is remembered, in place of the oldest.
static NSVCD__NOINLINE uint32_t nsvcd__not_separated_anew(nsvcd__search *search, size_t g,
                                                          size_t s, size_t j, float deviation,
                                                          uint32_t met) {
  nsvcd__plane_cache *cache = search->cache;
  const nsvcd__resting rest = nsvcd__resting_of(search->fixed, j);
  const int8_t *extremes = nsvcd__group_extremes(search->moving, g);
  const nsvcd_body *moving = search->moving;
  const nsvcd__chords *c = &search->members[s];
  nsvcd__passing p;
  nsvcd__passing_turns(search, s, &p);
  for (size_t n = 0; n < NSVCD__DIRECTIONS && met; n++) {
    nsvcd__f3 plane = {0, 0, 0};
    uint32_t separated = 0;
    NSVCD__EACH_SLICE(l) {
      const size_t i = NSVCD__GROUP * g + l;
      if (!(met >> l & NSVCD__SLICE_MASK)) continue;
      p.extremes = extremes + l;
      p.step = nsvcd__v_scale(nsvcd__v_load(nsvcd__body_r(moving) + i), 1.0f / 127);
      p.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(rest.centre));
      p.travel = nsvcd__chords_travel(c, l);
      const nsvcd__v inflate = nsvcd__v_scale(p.step, 127 * search->scale * cache->inflate);
      p.deviation = nsvcd__v_plus(inflate, deviation + rest.radius * cache->inflate);
      nsvcd__v3 u = nsvcd__v3_set(rest.normal);
      if (n == NSVCD__ALONG_LINE) {
        u = nsvcd__v3_unit(nsvcd__v3_fma(nsvcd__v_set(0.5f), p.travel, p.from));
      } else if (n != NSVCD__ALONG_RESTING) {
        const float *areas = nsvcd__body_areas(moving) + i;
        const nsvcd__v3 area = nsvcd__v3_load_rows(areas, moving->padded);
        const nsvcd__v3 before = nsvcd__vmat3_apply(p.start, area);
        // halfway
        const nsvcd__v3 own =
            nsvcd__v3_unit(nsvcd__v3_add(before, nsvcd__vmat3_apply(p.end, area)));
        u = n == NSVCD__ALONG_MOVING ? own : nsvcd__v3_unit(nsvcd__v3_sub(u, own));
      }
      const uint32_t here =
          nsvcd__separated_along(&p, &rest, u) & (met >> l & NSVCD__SLICE_MASK);
      if (here && !separated) {
        float lanes[3 * NSVCD__SLICE];
        nsvcd__v3_store_rows(u, lanes, NSVCD__SLICE);
        plane = nsvcd__f3_get(lanes + nsvcd__low_bit(here), NSVCD__SLICE);
      }
      separated |= here << l;
    }
    met &= ~separated;
    if (!separated) continue;
    const size_t oldest = cache->found++ % NSVCD__PLANES;
    cache->planes[oldest] = plane;
    cache->moving_known = (uint16_t)(cache->moving_known & ~(1u << oldest));
    cache->resting_known = (uint16_t)(cache->resting_known & ~(1u << oldest));
  }
  return met;
}

// The lanes of moving group g that meet member k of group h of the fixed body in segment s: whose
// balls do, and that nothing parts. before: those that met it in the segment before, which own
// planes will not part either, as a rule.
static uint32_t nsvcd__members_meet(nsvcd__search *search, size_t g, size_t s, size_t h,
                                    size_t k, nsvcd__sphere ball, float deviation,
                                    uint32_t before) {
  uint32_t met = nsvcd__meet(&search->members[s], ball);
  search->balls_met |= met != 0;
  if (search->cache->unasked) return met;
  if (met) met = nsvcd__not_separated_again(search, g, s, h, k, deviation, met);
  const uint32_t fresh = met & ~before;
  if (!fresh) return met;
  const size_t j = NSVCD__GROUP * h + k;
  return (met & before) | nsvcd__not_separated_anew(search, g, s, j, deviation, fresh);
}
#endif  // NSVCD_NO_NETWORK
