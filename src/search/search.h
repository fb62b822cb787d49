// In: two bodies, and a motion that has been cut. Out: each pair of patches whose spheres meet, and
// the segments in which they do, group by group.
//
// The hierarchy: body against body; boxes of groups against groups; group against group; group
// against 16 spheres; 16 spheres against a sphere. But for the boxes every step is the same test,
// moving spheres on chords against resting ones; lanes are segments, or members of a group. A step
// of the search is a pair of groups. Moving groups that meet most come first, and of each the group
// that it meets longest: a deep collision is then found before the rest is searched.
//
// A *tile* is up to 32 groups of one body and up to 32 of the other, which are searched together.
// Bodies of up to 512 patches are one tile. Of larger ones, a traversal of the levels of spheres
// above the groups finds those that the other body comes near, and they are searched tile after
// tile: each moving tile against all tiles of the fixed body.
#pragma once
#include "intervals.h"

// Boxes that contain 16 groups of the moving tile, from `first` on, in those segments `wanted` in
// which they meet the fixed body's sphere, in its axes and units. Empty, low above high, for groups
// that never do.
static void nsvcd__boxes_of_groups(const nsvcd__search *q, size_t first, uint64_t wanted,
                                   nsvcd__boxes *out) {
  const nsvcd__spheres groups = nsvcd__spheres_from(q->moving_tile.spheres, first);
  const nsvcd__sphere fixed = nsvcd__body_sphere(q->fixed);
  nsvcd__chords *c = nsvcd__spare_chords(q);
  for (size_t n = 0; n < 3 * NSVCD__LANES; n++) {
    out->low[n / NSVCD__LANES][n % NSVCD__LANES] = -NSVCD__NOWHERE;
    out->high[n / NSVCD__LANES][n % NSVCD__LANES] = NSVCD__NOWHERE;
  }
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    nsvcd__chords_in_segment(q, s, groups, q->moving->extent, c);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v nowhere = nsvcd__v_set(NSVCD__NOWHERE);
      const nsvcd__v3 start = nsvcd__chords_start(c, l);
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_set(fixed.centre));
      const nsvcd__v radius = nsvcd__v_load(c->radius + l);
      const nsvcd__v sum = nsvcd__v_plus(radius, fixed.radius);
      const nsvcd__v square = nsvcd__nearest2(d, travel, nsvcd__v_load(c->inverse + l));
      const nsvcd__v nearby =
          nsvcd__v_pick(square, nsvcd__v_signed_square(sum), radius, nowhere);
      const nsvcd__v3 end = nsvcd__v3_add(start, travel);
      const nsvcd__v3 around = nsvcd__v3_of(nearby, nearby, nearby);
      const nsvcd__v3 low = nsvcd__v3_sub(nsvcd__v3_min(start, end), around);
      const nsvcd__v3 high = nsvcd__v3_add(nsvcd__v3_max(start, end), around);
      nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_load(out->low, l), low));
      nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_load(out->high, l), high));
    }
  }
}

// Which of 16 spheres overlap a box?
static uint32_t nsvcd__spheres_at_box(nsvcd__box box, nsvcd__spheres all) {
  const nsvcd__v3 none = nsvcd__v3_set(nsvcd__f3_of(0, 0, 0));
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(all, l);
    const nsvcd__v3 below = nsvcd__v3_sub(nsvcd__v3_set(box.low), centre);
    const nsvcd__v3 above = nsvcd__v3_sub(centre, nsvcd__v3_set(box.high));
    const nsvcd__v3 d = nsvcd__v3_max(nsvcd__v3_max(below, above), none);
    const nsvcd__v radius = nsvcd__v_load(all.r + l);
    met |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(radius)) << l;
  }
  return met;
}

static uint64_t nsvcd__all_segments(const nsvcd__search *q) {
  return ~(uint64_t)0 >> (NSVCD__MAX_SEGMENTS - q->segments);
}

// Orders the steps of the search of both tiles: the groups of the moving tile that meet some of the
// fixed tile, those first that meet most of them in most segments. nsvcd__nearby says which, and
// in which segments. wanted: segments in which the bodies' spheres meet.
static void nsvcd__search_tile(nsvcd__search *q, uint64_t wanted) {
  uint16_t meetings[NSVCD__TILE_SLOTS];
  const nsvcd__tile *tile = &q->fixed_tile;
  nsvcd__boxes *boxes = nsvcd__spare_boxes(q);
  q->steps = q->step = 0;
  q->waiting = 0;
  for (size_t g = 0; g < q->moving_tile.count; g++) {
    const size_t l = g % NSVCD__LANES;
    if (l == 0) nsvcd__boxes_of_groups(q, g, wanted, boxes);
    const nsvcd__box box = {nsvcd__lane_of(boxes->low, l), nsvcd__lane_of(boxes->high, l)};
    uint32_t groups = 0;
    for (size_t first = 0; first < tile->count; first += NSVCD__LANES)
      groups |= nsvcd__spheres_at_box(box, nsvcd__spheres_from(tile->spheres, first)) << first;
    if (!groups) continue;
    uint64_t *nearby = nsvcd__nearby(q, g);
    size_t count = 0;
    nsvcd__chords_of_group(q, q->moving_tile.groups[g]);
    memset(nearby, 0, tile->count * sizeof *nearby);
    for (; groups; groups &= groups - 1) {
      const size_t h = nsvcd__low_bit(groups);
      const nsvcd__sphere resting = nsvcd__sphere_of(tile->spheres, h);
      nearby[h] = nsvcd__meet_in(q, nsvcd__all_segments(q), resting);
      count += nsvcd__bit_count(nearby[h]);
    }
    if (!count) continue;
    size_t at = q->steps;
    for (; at > 0 && meetings[at - 1] < count; at--) {
      meetings[at] = meetings[at - 1];
      q->order[at] = q->order[at - 1];
    }
    meetings[at] = (uint16_t)count;
    q->order[at] = (uint16_t)g;
    q->steps++;
  }
}

// Fills a tile with the next groups that a traversal finds.
static void nsvcd__tile_fill(nsvcd__tile *tile, nsvcd__traversal *traversal) {
  size_t g;
  tile->spheres = nsvcd__spheres_of(tile->collected, NSVCD__TILE_SLOTS);
  for (size_t n = 0; n < 4 * NSVCD__TILE_SLOTS; n++)
    tile->collected[n] = n < 3 * NSVCD__TILE_SLOTS ? 0 : NSVCD__NOWHERE;
  tile->count = 0;
  while (tile->count < NSVCD__TILE && nsvcd__traversal_next(traversal, &g)) {
    const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(traversal->body), g);
    nsvcd__sphere_store(group, tile->collected, NSVCD__TILE_SLOTS, tile->count);
    tile->groups[tile->count++] = (uint16_t)g;
  }
}

// Fills a tile with all groups of a body.
static void nsvcd__tile_fill_all(nsvcd__tile *tile, const nsvcd_body *body) {
  tile->count = nsvcd__body_groups(body);
  for (size_t g = 0; g < tile->count; g++) tile->groups[g] = (uint16_t)g;
  tile->spheres = nsvcd__groups_of(body);
}

// ---- filters of a traversal, which are given the search

// All spheres but padding.
static uint32_t nsvcd__exists(const void *what, nsvcd__spheres all) {
  uint32_t exists = 0;
  (void)what;
  NSVCD__EACH_SLICE(l) exists |= nsvcd__v_le(nsvcd__v_set(0), nsvcd__v_load(all.r + l)) << l;
  return exists;
}

// Spheres of the moving body that meet that of the fixed one.
static uint32_t nsvcd__comes_near(const void *what, nsvcd__spheres all) {
  const nsvcd__search *q = (const nsvcd__search *)what;
  const nsvcd__sphere fixed = nsvcd__body_sphere(q->fixed);
  nsvcd__chords *chords = nsvcd__spare_chords(q);
  uint32_t met = 0;
  for (uint64_t wanted = q->near_segments; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    nsvcd__chords_in_segment(q, s, all, q->moving->extent, chords);
    met |= nsvcd__meet(chords, fixed);
  }
  return met;
}

// Spheres of the fixed body that meet that of the moving tile, whose chords are q->group.
static uint32_t nsvcd__is_approached(const void *what, nsvcd__spheres all) {
  const nsvcd__search *q = (const nsvcd__search *)what;
  const uint32_t nearby = nsvcd__spheres_at_box(q->near_box, all);
  uint32_t met = 0;
  for (uint64_t wanted = q->near_segments; wanted && nearby & ~met; wanted &= wanted - 1) {
    met |= nearby & nsvcd__meet_members(q, nsvcd__low_bit(wanted), all);
  }
  return met;
}

// Chords of the sphere over all groups of the moving tile, into q->group.
static void nsvcd__chords_of_tile(nsvcd__search *q) {
  const nsvcd__tile *tile = &q->moving_tile;
  nsvcd__sphere sphere = nsvcd__body_sphere(q->moving);
  if (nsvcd__is_large(q->moving)) sphere = nsvcd__cover_spheres(tile->spheres, tile->count);
  nsvcd__chords_in_all(q, sphere);
}

// Finds the next moving tile, an empty one if there is none, and starts a traversal of the fixed
// body's groups that come near it.
static void nsvcd__search_moving_tile(nsvcd__search *q) {
  nsvcd__box box = {{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
  nsvcd__tile_fill(&q->moving_tile, &q->moving_traversal);
  if (q->moving_tile.count == 0) return;
  nsvcd__chords_of_tile(q);
  for (uint64_t left = q->near_segments; left; left &= left - 1) {
    const size_t s = nsvcd__low_bit(left);
    nsvcd__chords *c = &q->group[s / NSVCD__LANES];
    const size_t l = s % NSVCD__LANES;
    const nsvcd__f3 start = nsvcd__lane_of(c->start, l);
    const nsvcd__f3 end = nsvcd__f3_add(start, nsvcd__lane_of(c->travel, l));
    const nsvcd__f3 around = nsvcd__f3_of(c->radius[l], c->radius[l], c->radius[l]);
    const nsvcd__f3 low = nsvcd__f3_sub(nsvcd__f3_min(start, end), around);
    const nsvcd__f3 high = nsvcd__f3_add(nsvcd__f3_max(start, end), around);
    box.low = nsvcd__f3_min(box.low, low);
    box.high = nsvcd__f3_max(box.high, high);
  }
  q->near_box = box;
  nsvcd__traversal_begin(&q->fixed_traversal, q->fixed, nsvcd__is_approached, q);
}

// Goes on to the next pair of tiles that has a step. 0 if there is none.
static int nsvcd__search_next_tile(nsvcd__search *q) {
  if (!nsvcd__is_tiled(q->moving, q->fixed)) return 0;
  while (q->moving_tile.count > 0) {
    nsvcd__chords_of_tile(q);
    nsvcd__tile_fill(&q->fixed_tile, &q->fixed_traversal);
    if (q->fixed_tile.count == 0) {
      nsvcd__search_moving_tile(q);
      continue;
    }
    nsvcd__search_tile(q, q->near_segments);
    if (q->steps > 0) return 1;
  }
  return 0;
}

// Starts the search of some segments. Returns 0 if the groups' spheres never meet there, so that
// there is no step to take.
static int nsvcd__search_begin(const nsvcd_body *moving, const nsvcd_body *fixed,
                               uint64_t segments, nsvcd__search *q) {
  q->moving = moving;
  q->fixed = fixed;
  nsvcd__chords_in_all(q, nsvcd__body_sphere(moving));
  const uint64_t all = segments & nsvcd__all_segments(q);
  const uint64_t wanted = nsvcd__meet_in(q, all, nsvcd__body_sphere(fixed));
  q->near_segments = wanted;
  q->wanted = segments;
  q->steps = 0;
  if (!nsvcd__is_tiled(moving, fixed)) {
    nsvcd__tile_fill_all(&q->moving_tile, moving);
    nsvcd__tile_fill_all(&q->fixed_tile, fixed);
    if (wanted) nsvcd__search_tile(q, wanted);
    return q->steps > 0;
  }
  q->moving_tile.count = 0;
  if (!wanted) return 0;
  nsvcd__filter *filter = nsvcd__is_large(moving) ? nsvcd__comes_near : nsvcd__exists;
  nsvcd__traversal_begin(&q->moving_traversal, moving, filter, q);
  nsvcd__search_moving_tile(q);
  return nsvcd__search_next_tile(q);
}

// No point of a group is farther from its body's origin, in the body's own units.
static float nsvcd__group_extent(const nsvcd_body *body, size_t g) {
  const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(body), g);
  return 1.000002f * (nsvcd__f3_norm(group.centre) + group.radius);
}

// Fills members[] for the segments `wanted` that are not ready.
static void nsvcd__pose_members(nsvcd__search *q, size_t g, uint64_t wanted) {
  uint64_t missing = wanted & ~q->ready;
  if (!missing) return;
  const nsvcd__spheres members = nsvcd__members_of(q->moving, g);
  q->extent = nsvcd__group_extent(q->moving, g);
  for (; missing; missing &= missing - 1) {
    const size_t s = nsvcd__low_bit(missing);
    nsvcd__chords_in_segment(q, s, members, q->extent, &q->members[s]);
  }
  q->ready |= wanted;
}

#ifndef NSVCD_NO_PROOF
// Patches of group h of the fixed body that the moving group meets, whose chords are q->group.
// segments (GROUP): in which of those `wanted`; written for these patches only.
static uint32_t nsvcd__group_against_members(const nsvcd__search *q, size_t h, uint64_t wanted,
                                             uint64_t *segments) {
  const nsvcd__spheres members = nsvcd__members_of(q->fixed, h);
  uint32_t met = 0;
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    uint32_t bits = nsvcd__meet_members(q, s, members);
    for (; bits; bits &= bits - 1) {
      const size_t l = nsvcd__low_bit(bits);
      segments[l] = (met >> l & 1 ? segments[l] : 0) | (uint64_t)1 << s;
      met |= 1u << l;
    }
  }
  return met;
}
#endif

// Turns to the next moving group in order, and to the fixed group that it meets longest.
static void nsvcd__search_group(nsvcd__search *q) {
  const size_t g = q->order[q->step];
  const uint64_t *nearby = nsvcd__nearby(q, g);
  size_t most = 0;
  q->at = 0;
  for (size_t h = 0; h < q->fixed_tile.count; h++) {
    const size_t count = nsvcd__bit_count(nearby[h] & q->wanted);
    if (count > 0) q->waiting |= (uint32_t)1 << h;
    if (count > most) {
      most = count;
      q->at = h;
    }
  }
  if (q->waiting) nsvcd__chords_of_group(q, q->moving_tile.groups[g]);
  q->ready = 0;
}

#ifndef NSVCD_NO_NETWORK
// Finds all contact intervals of moving group g, whose chords are q->group, and the members
// `which` of group h of the fixed body, in the segments `wanted`.
static void nsvcd__group_against_group(nsvcd__search *q, size_t g, size_t h, uint32_t which,
                                       uint64_t wanted, nsvcd__candidates *kept) {
  const nsvcd__spheres members = nsvcd__members_of(q->fixed, h);
  const size_t stride = q->most_segments;
  uint64_t left[NSVCD__GROUP] = {0};
  uint32_t any = 0;
  nsvcd__plane_cache *cache = q->cache;
  cache->resting_known = 0;
  wanted = nsvcd__segments_left(q, h, wanted);
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    uint32_t bits = which & nsvcd__meet_members(q, s, members);
    if (!bits) continue;
    nsvcd__pose_members(q, g, (uint64_t)1 << s);
    cache->deviation = nsvcd__segment_deviation(q, s, q->extent);
    cache->moving_known = 0;
    bits = nsvcd__members_left(q, g, s, h, bits);
    for (; bits; bits &= bits - 1) {
      const size_t k = nsvcd__low_bit(bits);
      uint16_t *met = q->met + stride * k;
      const uint32_t before = s > 0 && left[k] >> (s - 1) & 1 ? met[s - 1] : 0;
      const uint32_t lanes = nsvcd__members_meet(q, g, s, h, k, before);
      if (!lanes) continue;
      met[s] = (uint16_t)lanes;
      left[k] |= (uint64_t)1 << s;
      any |= 1u << k;
    }
  }
  for (; any; any &= any - 1) {
    const size_t k = nsvcd__low_bit(any);
    const size_t j = NSVCD__GROUP * h + k;
    const uint16_t *met = q->met + stride * k;
    const uint64_t cuts = nsvcd__interval_cuts(q, met, left[k]);
    NSVCD__EACH_SLICE(l) {
      const size_t i = NSVCD__GROUP * g + l;
      nsvcd__slice_against_patch(q, i, j, left[k], met, cuts, kept);
    }
  }
}

// Finds all contact intervals of the next pair of groups.
static void nsvcd__search_pair(nsvcd__search *q, nsvcd__candidates *kept) {
  if (!q->waiting) nsvcd__search_group(q);
  const size_t next = q->order[q->step];
  const size_t g = q->moving_tile.groups[next];
  const size_t h = q->fixed_tile.groups[q->at];
  const uint64_t wanted = nsvcd__nearby(q, next)[q->at];
  nsvcd__group_against_group(q, g, h, 0xffff, wanted, kept);
}

// A step of the search: the next pair of groups. Returns 1 if there are more.
static NSVCD__NOINLINE int nsvcd__search_step(nsvcd__search *q, nsvcd__candidates *kept) {
  nsvcd__search_pair(q, kept);
  q->waiting &= ~((uint32_t)1 << q->at);
  if (q->waiting)
    q->at = nsvcd__low_bit(q->waiting);
  else
    q->step++;
  return q->step < q->steps || nsvcd__search_next_tile(q);
}

// Instead of a search: finds all contact intervals of one moving group and one patch of the fixed
// body.
static void nsvcd__search_patch(nsvcd__search *q, const nsvcd_body *moving, size_t g,
                                const nsvcd_body *fixed, size_t j, nsvcd__candidates *kept) {
  const uint64_t all = nsvcd__all_segments(q);
  q->moving = moving;
  q->fixed = fixed;
  q->ready = 0;
  nsvcd__chords_of_group(q, g);
  nsvcd__group_against_group(q, g, j / NSVCD__GROUP, 1u << j % NSVCD__GROUP, all, kept);
}

#endif  // NSVCD_NO_NETWORK
