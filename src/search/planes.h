// In: 16 moving patches whose balls meet that of a resting one in a segment. Out: those that no
// plane separates from it all the time, by the hulls of their extremes.
//
// Planes are tried across the resting patch's normal, the moving patches', their difference, the
// lines between the centres, and first across the last few that separated other patches of the same
// query: one plane separates a table from what stands on it, whole groups at a time. Extremes go on
// chords, as centres do, and the deviation of points is allowed for. But extremes are not all of a
// patch, so this is no proof: if a greater recall is asked for, patches are inflated first.
#pragma once
#include "../segments/chords.h"

#ifndef NSVCD_NO_NETWORK
// Begins the search of a motion.
static void nsvcd__plane_cache_begin(nsvcd__search *q, float inflate) {
  q->cache->found = q->cache->best = 0;
  q->cache->inflate = inflate;
  // inflated by their radii, patches meet wherever their balls do
  q->cache->balls_only = inflate >= 1;
  q->balls_met = 0;
}

static size_t nsvcd__planes_known(const nsvcd__search *q) {
  const size_t found = q->cache->found;
  return found < NSVCD__PLANES ? found : NSVCD__PLANES;
}

// ---- ranges

// Of the extremes (EXTREMES, 3, 16) of a slice of patches, along u. step: of the extremes, in the
// body's units; height: of the patches' centres.
NSVCD__INLINE nsvcd__v_range nsvcd__extremes_along(const int8_t *extremes, nsvcd__v step,
                                                   nsvcd__v3 u, nsvcd__v height) {
  nsvcd__v low = nsvcd__v_set(1e30f);
  nsvcd__v high = nsvcd__v_set(-1e30f);
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__LANES) {
    const nsvcd__v3 x = nsvcd__v3_load_int8(extremes, NSVCD__LANES);
    const nsvcd__v along = nsvcd__v3_dot(x, u);
    low = nsvcd__v_min(low, along);
    high = nsvcd__v_max(high, along);
  }
  const nsvcd__v_range out = {nsvcd__v_fma(step, low, height),
                              nsvcd__v_fma(step, high, height)};
  return out;
}

// The same at both ends of a segment, between which the normal turns in the body's frame.
NSVCD__INLINE nsvcd__v_range nsvcd__moving_range(const int8_t *extremes, nsvcd__v step,
                                                 nsvcd__v3 u, nsvcd__v3 u_end, nsvcd__v height,
                                                 nsvcd__v height_end) {
  const nsvcd__v_range a = nsvcd__extremes_along(extremes, step, u, height);
  const nsvcd__v_range b = nsvcd__extremes_along(extremes, step, u_end, height_end);
  const nsvcd__v_range out = {nsvcd__v_min(a.low, b.low), nsvcd__v_max(a.high, b.high)};
  return out;
}

// Stores a range that is wider by `off` on both sides.
static void nsvcd__ranges_store(nsvcd__v_range range, nsvcd__v off, size_t l,
                                nsvcd__ranges *out) {
  nsvcd__v_store(out->low + l, nsvcd__v_sub(range.low, off));
  nsvcd__v_store(out->high + l, nsvcd__v_add(range.high, off));
}

// Fills in the ranges of group h of the fixed body along plane n.
static void nsvcd__know_resting(const nsvcd__search *q, size_t h, size_t n) {
  nsvcd__plane_cache *cache = q->cache;
  if (cache->resting_known >> n & 1) return;
  cache->resting_known |= 1u << n;
  const nsvcd__spheres patches = nsvcd__members_of(q->fixed, h);
  const int8_t *extremes = nsvcd__group_extremes(q->fixed, h);
  const nsvcd__v3 u = nsvcd__v3_set(cache->planes[n]);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v step = nsvcd__v_scale(nsvcd__v_load(patches.r + l), 1.0f / 127);
    const nsvcd__v height = nsvcd__v3_dot(u, nsvcd__v3_centres(patches, l));
    const nsvcd__v_range range = nsvcd__extremes_along(extremes + l, step, u, height);
    const nsvcd__v inflate = nsvcd__v_scale(step, 127 * cache->inflate);
    nsvcd__ranges_store(range, inflate, l, &cache->resting[n]);
  }
}

// Fills in the ranges of moving group g in segment s along plane n, deviation included.
static void nsvcd__know_moving(const nsvcd__search *q, size_t g, size_t s, size_t n) {
  nsvcd__plane_cache *cache = q->cache;
  if (cache->moving_known >> n & 1) return;
  cache->moving_known |= 1u << n;
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const nsvcd__chords *c = &q->members[s];
  const nsvcd__f3 normal = cache->planes[n];
  const nsvcd__mat3 rotation = nsvcd__mat3_lane(block->rotation, s % NSVCD__LANES);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, s % NSVCD__LANES);
  const nsvcd__f3 start = nsvcd__mat3_apply_transpose(&rotation, normal);
  const nsvcd__f3 change = nsvcd__mat3_apply_transpose(&turned, normal);
  const nsvcd__v3 u_start = nsvcd__v3_set(start);
  const nsvcd__v3 u_end = nsvcd__v3_set(nsvcd__f3_add(start, change));
  const nsvcd__v3 u = nsvcd__v3_set(normal);
  const float *radii = nsvcd__body_r(q->moving) + NSVCD__GROUP * g;
  const int8_t *extremes = nsvcd__group_extremes(q->moving, g);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v step = nsvcd__v_scale(nsvcd__v_load(radii + l), 1.0f / 127);
    const nsvcd__v height = nsvcd__v3_dot(u, nsvcd__chords_start(c, l));
    const nsvcd__v height_end = nsvcd__v3_dot_add(u, nsvcd__chords_travel(c, l), height);
    const nsvcd__v_range range =
        nsvcd__moving_range(extremes + l, step, u_start, u_end, height, height_end);
    const nsvcd__v inflate = nsvcd__v_scale(step, 127 * q->scale * cache->inflate);
    nsvcd__ranges_store(range, nsvcd__v_plus(inflate, cache->deviation), l, &cache->moving[n]);
  }
}

// ---- planes that separated others

// The least of all lanes, times a sign.
static float nsvcd__least_lane(const float *lanes, float sign) {
  nsvcd__v least = nsvcd__v_set(1e30f);
  NSVCD__EACH_SLICE(l)
  least = nsvcd__v_min(least, nsvcd__v_scale(nsvcd__v_load(lanes + l), sign));
  return nsvcd__v_least(least);
}

// Lanes whose ranges do not overlap low to high.
static uint32_t nsvcd__lanes_outside(const nsvcd__ranges *ranges, float low, float high) {
  const nsvcd__v lowest = nsvcd__v_set(low);
  const nsvcd__v highest = nsvcd__v_set(high);
  uint32_t outside = 0;
  NSVCD__EACH_SLICE(l) {
    outside |= nsvcd__v_lt(highest, nsvcd__v_load(ranges->low + l)) << l;
    outside |= nsvcd__v_lt(nsvcd__v_load(ranges->high + l), lowest) << l;
  }
  return outside;
}

// Of the segments `wanted`, those in which the plane that separated last does not separate the
// moving group's ball, whose chords are q->group, from all of group h of the fixed body.
static uint64_t nsvcd__segments_left(const nsvcd__search *q, size_t h, uint64_t wanted) {
  nsvcd__plane_cache *cache = q->cache;
  const size_t n = cache->best;
  uint64_t separated = 0;
  if (n >= nsvcd__planes_known(q)) return wanted;
  nsvcd__know_resting(q, h, n);
  const nsvcd__ranges *resting = &cache->resting[n];
  const nsvcd__v below = nsvcd__v_set(nsvcd__least_lane(resting->low, 1));
  const nsvcd__v above = nsvcd__v_set(-nsvcd__least_lane(resting->high, -1));
  const nsvcd__v3 u = nsvcd__v3_set(cache->planes[n]);
  for (size_t s = 0; s < q->segments; s += NSVCD__LANES) {
    const nsvcd__chords *c = &q->group[s / NSVCD__LANES];
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
// from all of moving group g in segment s.
static uint32_t nsvcd__members_left(const nsvcd__search *q, size_t g, size_t s, size_t h,
                                    uint32_t bits) {
  const nsvcd__plane_cache *cache = q->cache;
  const size_t n = cache->best;
  if (n >= nsvcd__planes_known(q)) return bits;
  nsvcd__know_resting(q, h, n);
  nsvcd__know_moving(q, g, s, n);
  const float low = nsvcd__least_lane(cache->moving[n].low, 1);
  const float high = -nsvcd__least_lane(cache->moving[n].high, -1);
  return bits & ~nsvcd__lanes_outside(&cache->resting[n], low, high);
}

// Of the lanes `met` of moving group g in segment s, those that no remembered plane separates from
// member k of group h of the fixed body.
static uint32_t nsvcd__lanes_left_by_known(nsvcd__search *q, size_t g, size_t s, size_t h,
                                           size_t k, uint32_t met) {
  nsvcd__plane_cache *cache = q->cache;
  const size_t planes = nsvcd__planes_known(q);
  for (size_t m = 0; m < planes && met; m++) {
    const size_t n = (cache->best + m) % planes;  // the one that separated last, first
    nsvcd__know_resting(q, h, n);
    nsvcd__know_moving(q, g, s, n);
    const nsvcd__ranges *resting = &cache->resting[n];
    const uint32_t separated =
        nsvcd__lanes_outside(&cache->moving[n], resting->low[k], resting->high[k]);
    if (met & separated) cache->best = (uint32_t)n;
    met &= ~separated;
  }
  return met;
}

// ---- planes of their own

// A resting patch: its extremes are relative to its centre, metres.
typedef struct nsvcd__resting {
  nsvcd__f3 centre;
  float radius;
  nsvcd__f3 extremes[NSVCD__EXTREMES];
  nsvcd__f3 normal;  // the mean
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
  const float length = nsvcd__f3_norm(area);
  out.normal = nsvcd__f3_scale(area, length > 0 ? 1 / length : 0);
  return out;
}

// A slice of moving patches, over a segment.
typedef struct nsvcd__passing {
  const int8_t *extremes;   // (EXTREMES, 3, 16) and lane l, of the moving group
  nsvcd__v step;            // of the extremes, in the body's units
  nsvcd__v3 from, travel;   // from the resting centre to the moving one; and along the chord
  nsvcd__vmat3 start, end;  // rotations, times the scale
  nsvcd__v deviation;       // of points, and what patches are inflated by
} nsvcd__passing;

// Lanes in which a plane across u separates both, on either side.
NSVCD__INLINE uint32_t nsvcd__separated_along(const nsvcd__passing *p,
                                              const nsvcd__resting *rest, nsvcd__v3 u) {
  const nsvcd__v3 u_start = nsvcd__vmat3_apply_transpose(p->start, u);
  const nsvcd__v3 u_end = nsvcd__vmat3_apply_transpose(p->end, u);
  const nsvcd__v height = nsvcd__v3_dot(u, p->from);
  const nsvcd__v height_end = nsvcd__v3_dot_add(u, p->travel, height);
  const nsvcd__v_range moving =
      nsvcd__moving_range(p->extremes, p->step, u_start, u_end, height, height_end);
  nsvcd__v below = nsvcd__v_set(1e30f);
  nsvcd__v above = nsvcd__v_set(-1e30f);
  for (size_t k = 0; k < NSVCD__EXTREMES; k++) {
    const nsvcd__v along = nsvcd__v3_dot(nsvcd__v3_set(rest->extremes[k]), u);
    below = nsvcd__v_min(below, along);
    above = nsvcd__v_max(above, along);
  }
  return nsvcd__v_lt(above, nsvcd__v_sub(moving.low, p->deviation)) |
         nsvcd__v_lt(nsvcd__v_add(moving.high, p->deviation), below);
}

enum {
  NSVCD__ALONG_RESTING,  // normal
  NSVCD__ALONG_MOVING,   // normals
  NSVCD__ALONG_LINE,     // between the centres
  NSVCD__ALONG_BOTH,     // normals, from one to the other
  NSVCD__DIRECTIONS
};

// Of the lanes `met` of moving group g in segment s, those that no plane of their own separates
// from patch j of the fixed body. A plane that does replaces the oldest that is remembered.
static NSVCD__NOINLINE uint32_t nsvcd__lanes_left_by_own(nsvcd__search *q, size_t g, size_t s,
                                                         size_t j, uint32_t met) {
  nsvcd__plane_cache *cache = q->cache;
  const nsvcd__resting rest = nsvcd__resting_of(q->fixed, j);
  const int8_t *extremes = nsvcd__group_extremes(q->moving, g);
  const nsvcd_body *moving = q->moving;
  const nsvcd__chords *c = &q->members[s];
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, s % NSVCD__LANES);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, s % NSVCD__LANES);
  const nsvcd__mat3 end = nsvcd__mat3_mix(1, &start, 1, &turned);
  nsvcd__passing p;
  p.start = nsvcd__vmat3_set(&start);
  p.end = nsvcd__vmat3_set(&end);
  for (size_t n = 0; n < NSVCD__DIRECTIONS && met; n++) {
    nsvcd__f3 plane = {0, 0, 0};
    uint32_t separated = 0;
    NSVCD__EACH_SLICE(l) {
      const size_t i = NSVCD__GROUP * g + l;
      const uint32_t lanes = met >> l & NSVCD__SLICE_MASK;
      if (!lanes) continue;
      p.extremes = extremes + l;
      p.step = nsvcd__v_scale(nsvcd__v_load(nsvcd__body_r(moving) + i), 1.0f / 127);
      p.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(rest.centre));
      p.travel = nsvcd__chords_travel(c, l);
      const nsvcd__v inflate = nsvcd__v_scale(p.step, 127 * q->scale * cache->inflate);
      p.deviation = nsvcd__v_plus(inflate, cache->deviation + rest.radius * cache->inflate);
      nsvcd__v3 u = nsvcd__v3_set(rest.normal);
      if (n == NSVCD__ALONG_LINE) {
        u = nsvcd__v3_unit(nsvcd__v3_fma(nsvcd__v_set(0.5f), p.travel, p.from));
      } else if (n != NSVCD__ALONG_RESTING) {
        const float *areas = nsvcd__body_areas(moving) + i;
        const nsvcd__v3 area = nsvcd__v3_get(areas, moving->padded);
        const nsvcd__v3 first = nsvcd__vmat3_apply(p.start, area);
        const nsvcd__v3 last = nsvcd__vmat3_apply(p.end, area);
        const nsvcd__v3 halfway = nsvcd__v3_unit(nsvcd__v3_add(first, last));
        u = n == NSVCD__ALONG_MOVING ? halfway : nsvcd__v3_unit(nsvcd__v3_sub(u, halfway));
      }
      const uint32_t here = nsvcd__separated_along(&p, &rest, u) & lanes;
      if (here && !separated) {
        float rows[3 * NSVCD__SLICE];
        nsvcd__v3_put(u, rows, NSVCD__SLICE);
        plane = nsvcd__f3_get(rows + nsvcd__low_bit(here), NSVCD__SLICE);
      }
      separated |= here << l;
    }
    met &= ~separated;
    if (!separated) continue;
    const size_t oldest = cache->found++ % NSVCD__PLANES;
    cache->planes[oldest] = plane;
    cache->moving_known &= ~(1u << oldest);
    cache->resting_known &= ~(1u << oldest);
  }
  return met;
}

// The lanes of moving group g whose balls meet member k of group h of the fixed body in segment s,
// and that no plane separates from it. before: those that met it in the segment before: planes of
// their own would rarely separate them now.
static uint32_t nsvcd__members_meet(nsvcd__search *q, size_t g, size_t s, size_t h, size_t k,
                                    uint32_t before) {
  const size_t j = NSVCD__GROUP * h + k;
  const nsvcd__sphere ball = nsvcd__sphere_of(nsvcd__body_patches(q->fixed), j);
  uint32_t met = nsvcd__meet(&q->members[s], ball);
  q->balls_met |= met != 0;
  if (q->cache->balls_only) return met;
  if (met) met = nsvcd__lanes_left_by_known(q, g, s, h, k, met);
  const uint32_t fresh = met & ~before;
  if (!fresh) return met;
  return (met & before) | nsvcd__lanes_left_by_own(q, g, s, j, fresh);
}
#endif  // NSVCD_NO_NETWORK
