// In: a motion that has been cut, and spheres of the moving body. Out: the spheres on chords, in
// all segments or in one, and which of them meet spheres of the fixed body.
//
// Along its chord a sphere's radius grows by margin + bend |c|, c being its centre, so that it
// covers the sphere at its true pose all the time. So the test is conservative: spheres that meet
// at any time have chords that meet then, and if no chords do, the surfaces never meet, which is a
// proof. A group or a whole body is a sphere like any other: its sphere contains its members'.
#pragma once
#include "segments.h"

NSVCD__INLINE nsvcd__v3 nsvcd__chords_start(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->start[0] + l);
}
NSVCD__INLINE nsvcd__v3 nsvcd__chords_travel(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->travel[0] + l);
}
// Stores a slice of chords. FLT_MIN keeps a chord of no length finite.
static void nsvcd__chords_store(nsvcd__chords *c, size_t l, nsvcd__v3 start, nsvcd__v3 travel,
                                nsvcd__v radius) {
  const nsvcd__v least = nsvcd__v_set(1.2e-38f);
  const nsvcd__v square = nsvcd__v_max(nsvcd__v3_dot(travel, travel), least);
  nsvcd__v3_store(c->start, l, start);
  nsvcd__v3_store(c->travel, l, travel);
  nsvcd__v_store(c->inverse + l, nsvcd__v_div(nsvcd__v_set(-1), square));
  nsvcd__v_store(c->radius + l, radius);
}

// Chords of a sphere of the moving body in all segments, into q->group.
static void nsvcd__chords_in_all(nsvcd__search *q, nsvcd__sphere sphere) {
  sphere.radius *= q->scale;
  const nsvcd__v3 centre = nsvcd__v3_set(sphere.centre);
  const nsvcd__v length = nsvcd__v_set(nsvcd__f3_norm(sphere.centre));
  const nsvcd__v radius = nsvcd__v_set(sphere.radius);
  for (size_t s = 0; s < q->segments; s += NSVCD__LANES) {
    nsvcd__segments *b = &q->blocks[s / NSVCD__LANES];
    nsvcd__chords *out = &q->group[s / NSVCD__LANES];
    NSVCD__EACH_SLICE(l) {
      const nsvcd__vmat3 rotation = nsvcd__vmat3_load(b->rotation, l);
      const nsvcd__vmat3 turned = nsvcd__vmat3_load(b->turned, l);
      const nsvcd__v3 position = nsvcd__v3_load(b->position, l);
      const nsvcd__v3 moved = nsvcd__v3_load(b->moved, l);
      const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotation, centre, position);
      const nsvcd__v3 travel = nsvcd__vmat3_apply_add(turned, centre, moved);
      const nsvcd__v margin = nsvcd__v_load(b->margin + l);
      const nsvcd__v deviation = nsvcd__v_fma(nsvcd__v_load(b->bend + l), length, margin);
      nsvcd__chords_store(out, l, start, travel, nsvcd__v_add(deviation, radius));
    }
  }
}

// The 16 patches of a group.
static nsvcd__spheres nsvcd__members_of(const nsvcd_body *body, size_t g) {
  return nsvcd__spheres_from(nsvcd__body_patches(body), NSVCD__GROUP * g);
}

static void nsvcd__chords_of_group(nsvcd__search *q, size_t g) {
  nsvcd__chords_in_all(q, nsvcd__sphere_of(nsvcd__groups_of(q->moving), g));
}

// The deviation in segment s of points no farther than `extent` from the moving body's origin.
static float nsvcd__segment_deviation(const nsvcd__search *q, size_t s, float extent) {
  const nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  return block->margin[s % NSVCD__LANES] + block->bend[s % NSVCD__LANES] * extent;
}

// Chords of 16 spheres of the moving body in segment s. The patches in them are no farther than
// `extent` from the body's origin. Centres of spheres over patches may be farther, but on their
// chords the points of a body do not move relative to each other, so that the deviation of the
// patches is all to allow for.
static void nsvcd__chords_in_segment(const nsvcd__search *q, size_t s, nsvcd__spheres spheres,
                                     float extent, nsvcd__chords *out) {
  nsvcd__segments *b = &q->blocks[s / NSVCD__LANES];
  const size_t lane = s % NSVCD__LANES;
  const nsvcd__v deviation = nsvcd__v_set(nsvcd__segment_deviation(q, s, extent));
  const nsvcd__v scale = nsvcd__v_set(q->scale);
  const nsvcd__mat3 rotation = nsvcd__mat3_lane(b->rotation, lane);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(b->turned, lane);
  const nsvcd__v3 position = nsvcd__v3_set(nsvcd__lane_of(b->position, lane));
  const nsvcd__v3 moved = nsvcd__v3_set(nsvcd__lane_of(b->moved, lane));
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(spheres, l);
    const nsvcd__vmat3 rotations = nsvcd__vmat3_set(&rotation);
    const nsvcd__vmat3 turns = nsvcd__vmat3_set(&turned);
    const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotations, centre, position);
    const nsvcd__v3 travel = nsvcd__vmat3_apply_add(turns, centre, moved);
    const nsvcd__v radius = nsvcd__v_load(spheres.r + l);
    nsvcd__chords_store(out, l, start, travel, nsvcd__v_fma(scale, radius, deviation));
  }
}

// ---- tests

// The fraction of a chord at which it is nearest to a resting centre. d: from that to the start of
// the chord.
NSVCD__INLINE nsvcd__v nsvcd__nearest_at(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse) {
  return nsvcd__v_clamp(nsvcd__v_mul(nsvcd__v3_dot(d, travel), inverse), 0, 1);
}

// The square of a chord's distance from a resting centre. d: from that to the start of the chord.
NSVCD__INLINE nsvcd__v nsvcd__nearest2(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse) {
  const nsvcd__v tau = nsvcd__nearest_at(d, travel, inverse);
  const nsvcd__v3 nearest = nsvcd__v3_fma(tau, travel, d);
  return nsvcd__v3_dot(nearest, nearest);
}

// Lanes in which a chord comes within `radius` of a resting centre.
NSVCD__INLINE uint32_t nsvcd__comes_within(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse,
                                           nsvcd__v radius) {
  return nsvcd__v_le(nsvcd__nearest2(d, travel, inverse), nsvcd__v_signed_square(radius));
}

// 16 moving spheres, or one in 16 segments, against one resting sphere.
NSVCD__INLINE uint32_t nsvcd__meet(const nsvcd__chords *c, nsvcd__sphere resting) {
  const nsvcd__v3 centre = nsvcd__v3_set(resting.centre);
  const nsvcd__v radius = nsvcd__v_set(resting.radius);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v sum = nsvcd__v_add(nsvcd__v_load(c->radius + l), radius);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    met |= nsvcd__comes_within(d, nsvcd__chords_travel(c, l), inverse, sum) << l;
  }
  return met;
}

// The sphere whose chords are q->group, in segment s, against 16 resting spheres.
NSVCD__INLINE uint32_t nsvcd__meet_members(const nsvcd__search *q, size_t s,
                                           nsvcd__spheres resting) {
  nsvcd__chords *c = &q->group[s / NSVCD__LANES];
  const size_t lane = s % NSVCD__LANES;
  const nsvcd__v3 start = nsvcd__v3_set(nsvcd__lane_of(c->start, lane));
  const nsvcd__v3 travel = nsvcd__v3_set(nsvcd__lane_of(c->travel, lane));
  const nsvcd__v inverse = nsvcd__v_set(c->inverse[lane]);
  const nsvcd__v own = nsvcd__v_set(c->radius[lane]);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_centres(resting, l));
    const nsvcd__v radius = nsvcd__v_add(own, nsvcd__v_load(resting.r + l));
    met |= nsvcd__comes_within(d, travel, inverse, radius) << l;
  }
  return met;
}

// The segments among `wanted` in which the sphere whose chords are q->group meets a resting
// one.
NSVCD__INLINE uint64_t nsvcd__meet_in(const nsvcd__search *q, uint64_t wanted,
                                      nsvcd__sphere resting) {
  uint64_t met = 0;
  for (size_t s = 0; s < NSVCD__MAX_SEGMENTS && wanted >> s; s += NSVCD__LANES) {
    if (wanted >> s & 0xffff)
      met |= (uint64_t)nsvcd__meet(&q->group[s / NSVCD__LANES], resting) << s;
  }
  return met & wanted;
}
