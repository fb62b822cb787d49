// In: the chords of patches, and the patches of the other body that they meet. Out: candidates: the
// pairs, and when their balls meet.
#pragma once
#include "planes.h"

#ifndef NSVCD_NO_NETWORK
// radians, 45 degrees: an interval is cut before it turns more, for the decoder's twist
#define NSVCD__INTERVAL_TURN 0.785f
#define NSVCD__NO_SCORE (-1e30f)

static void nsvcd__candidates_start(nsvcd__candidates *kept, nsvcd__candidate *items,
                                    size_t limit) {
  const nsvcd__candidates none = {items, limit, 0, 0};
  *kept = none;
}

// A total order, so that ties do not depend on the order in which intervals were found.
static int nsvcd__is_shallower(const nsvcd__candidate *a, const nsvcd__candidate *b) {
  if (a->depth < b->depth || a->depth > b->depth) return a->depth < b->depth;
  if (a->moving != b->moving) return a->moving > b->moving;
  if (a->fixed != b->fixed) return a->fixed > b->fixed;
  return a->t_enter > b->t_enter;
}

// Counts an interval, and keeps it if there is room, or in place of the shallowest.
static void nsvcd__candidates_add(nsvcd__candidates *kept, const nsvcd__candidate *item) {
  nsvcd__candidate *heap = kept->items;
  size_t hole = 0;
  kept->total++;
  if (kept->count < kept->limit) {
    for (hole = kept->count++; hole > 0; hole = (hole - 1) / 2) {
      if (!nsvcd__is_shallower(item, &heap[(hole - 1) / 2])) break;
      heap[hole] = heap[(hole - 1) / 2];
    }
  } else {
    if (kept->limit == 0 || !nsvcd__is_shallower(&heap[0], item)) return;
    for (size_t child = 1; child < kept->count; child = 2 * hole + 1) {
      if (child + 1 < kept->count && nsvcd__is_shallower(&heap[child + 1], &heap[child]))
        child++;
      if (!nsvcd__is_shallower(&heap[child], item)) break;
      heap[hole] = heap[child];
      hole = child;
    }
  }
  heap[hole] = *item;
}

// Contact intervals of a slice that are still growing, one per lane. Parameters along a segment's
// line are 0 at its start and 1 at its end: at `nearest` the line is nearest to the other centre,
// and the spheres overlap from `nearest` - h to `nearest` + h; half2 is the square of h.
typedef struct nsvcd__intervals {
  uint32_t open;   // lanes
  size_t last;     // the segment that all of them reach
  nsvcd__v fresh;  // 1 in lanes without an interval, else 0
  nsvcd__v first, first_nearest, first_half2, last_nearest, last_half2;
  nsvcd__v square, least_segment, least;  // the least distance, squared, and where it is
} nsvcd__intervals;

// The time at a fraction of segment s: at 1 that of its end, to the bit.
static float nsvcd__time_in_segment(const nsvcd__search *q, size_t s, float fraction) {
  const float start = q->time[s];
  const float end = q->time[s + 1];
  return fraction < 1 ? start + fraction * (end - start) : end;
}

// Ends the intervals of `lanes`, and adds them to the candidates. The slice's first lane is patch i
// of the moving body; j: the patch of the fixed one.
static void nsvcd__intervals_close(nsvcd__intervals *intervals, uint32_t lanes,
                                   const nsvcd__search *q, size_t i, size_t j,
                                   nsvcd__candidates *kept) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v own = nsvcd__v_load(nsvcd__body_r(q->moving) + i);
  const nsvcd__v other = nsvcd__v_set(nsvcd__body_r(q->fixed)[j]);
  const nsvcd__v scaled = nsvcd__v_scale(own, q->scale);
  const nsvcd__v radii = nsvcd__v_max(nsvcd__v_add(scaled, other), nsvcd__v_set(1e-30f));
  intervals->open &= ~lanes;
  // Most are shallower than all of a full heap, and are only counted.
  if (kept->count == kept->limit) {
    const float depth = kept->limit ? (1 - kept->items[0].depth) * 1.000001f : 0;
    const nsvcd__v most = nsvcd__v_scale(radii, depth > 0 ? depth : 0);
    uint32_t deep = 0;
    if (kept->limit) deep = lanes & nsvcd__v_le(intervals->square, nsvcd__v_mul(most, most));
    kept->total += nsvcd__bit_count(lanes & ~deep);
    lanes = deep;
    if (!lanes) return;
  }

  float first[NSVCD__SLICE], enter[NSVCD__SLICE], leave[NSVCD__SLICE];
  float least_segment[NSVCD__SLICE], least[NSVCD__SLICE], depth[NSVCD__SLICE];
  const nsvcd__v before = nsvcd__v_sqrt(nsvcd__v_max(intervals->first_half2, zero));
  const nsvcd__v after = nsvcd__v_sqrt(nsvcd__v_max(intervals->last_half2, zero));
  const nsvcd__v fraction = nsvcd__v_div(nsvcd__v_sqrt(intervals->square), radii);
  nsvcd__v_store(first, intervals->first);
  nsvcd__v_store(least_segment, intervals->least_segment);
  nsvcd__v_store(enter, nsvcd__v_max(nsvcd__v_sub(intervals->first_nearest, before), zero));
  nsvcd__v_store(leave, nsvcd__v_min(nsvcd__v_add(intervals->last_nearest, after), one));
  nsvcd__v_store(least, intervals->least);
  nsvcd__v_store(depth, nsvcd__v_sub(one, fraction));
  for (; lanes; lanes &= lanes - 1) {
    const size_t l = nsvcd__low_bit(lanes);
    nsvcd__candidate candidate;
    candidate.moving = (uint16_t)(i + l);
    candidate.fixed = (uint16_t)j;
    candidate.t_enter = nsvcd__time_in_segment(q, (size_t)first[l], enter[l]);
    candidate.t_exit = nsvcd__time_in_segment(q, intervals->last, leave[l]);
    candidate.t_least = nsvcd__time_in_segment(q, (size_t)least_segment[l], least[l]);
    candidate.depth = depth[l];
    candidate.score = NSVCD__NO_SCORE;
    candidate.apart = 0;
    // Rounding must not put the nearest time outside.
    if (candidate.t_enter > candidate.t_least) candidate.t_enter = candidate.t_least;
    if (candidate.t_exit < candidate.t_least) candidate.t_exit = candidate.t_least;
    nsvcd__candidates_add(kept, &candidate);
  }
}

// The segments at whose start all contact intervals of a group's members are cut: because the
// oldest of them would turn too far, or the segment before is not `wanted`. met: (segments). For
// all 16 beforehand, so that machines with narrower slices find the same intervals.
static uint64_t nsvcd__interval_cuts(const nsvcd__search *q, const uint16_t *met,
                                     uint64_t wanted) {
  uint64_t cuts = wanted & ~(wanted << 1);
  uint32_t open = 0;
  size_t oldest = 0;
  if (!(q->turn[q->segments] > NSVCD__INTERVAL_TURN)) return cuts;
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    if (open && q->turn[s + 1] - q->turn[oldest] > NSVCD__INTERVAL_TURN)
      cuts |= (uint64_t)1 << s;
    if (cuts >> s & 1) open = 0;
    open &= met[s];
    if (!open) oldest = s;
    open = met[s];
  }
  return cuts;
}

// Contact intervals of a slice of moving patches, from patch i on, with patch j of the fixed body,
// in the segments `wanted`, in which the lanes all_met[s] of the group meet it. cuts:
// nsvcd__interval_cuts.
static NSVCD__NOINLINE void nsvcd__slice_against_patch(const nsvcd__search *q, size_t i,
                                                       size_t j, uint64_t wanted,
                                                       const uint16_t *all_met, uint64_t cuts,
                                                       nsvcd__candidates *kept) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(q->fixed), j);
  const nsvcd__v3 centre = nsvcd__v3_set(patch.centre);
  const size_t l = i % NSVCD__GROUP;
  nsvcd__intervals at = {0, 0, one, zero, zero, zero, zero, zero, zero, zero, zero};
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    const nsvcd__chords *c = &q->members[s];
    const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    const nsvcd__v radius = nsvcd__v_plus(nsvcd__v_load(c->radius + l), patch.radius);
    // the square of the sum of radii; where the line is nearest, and where the chord is
    const nsvcd__v limit = nsvcd__v_signed_square(radius);
    const nsvcd__v nearest = nsvcd__v_mul(nsvcd__v3_dot(d, travel), inverse);
    const nsvcd__v tau = nsvcd__v_clamp(nearest, 0, 1);
    const nsvcd__v3 chord = nsvcd__v3_fma(tau, travel, d);
    const nsvcd__v square = nsvcd__v3_dot(chord, chord);
    const uint32_t met = all_met[s] >> l & NSVCD__SLICE_MASK;
    const int is_cut = (int)(cuts >> s & 1);
    const uint32_t ended = is_cut ? at.open : at.open & ~met;
    if (ended) nsvcd__intervals_close(&at, ended, q, i, j, kept);
    if (is_cut || !met) at.fresh = one;
    if (!met) continue;

    // Intervals go on, or begin. |d + tau travel| = radius, solved from the line's nearest point
    // outwards: b^2 - ac would cancel on long chords.
    const nsvcd__v segment = nsvcd__v_set((float)s);
    const nsvcd__v3 line = nsvcd__v3_fma(nearest, travel, d);
    const nsvcd__v half2 =
        nsvcd__v_mul(nsvcd__v_sub(nsvcd__v3_dot(line, line), limit), inverse);
    const nsvcd__v before = nsvcd__v_pick(half, at.fresh, nsvcd__v_set(1e38f), at.square);
    at.first = nsvcd__v_pick(half, at.fresh, segment, at.first);
    at.first_nearest = nsvcd__v_pick(half, at.fresh, nearest, at.first_nearest);
    at.first_half2 = nsvcd__v_pick(half, at.fresh, half2, at.first_half2);
    at.last_nearest = nearest;
    at.last_half2 = half2;
    at.least_segment = nsvcd__v_pick(square, before, segment, at.least_segment);
    at.least = nsvcd__v_pick(square, before, tau, at.least);
    at.square = nsvcd__v_min(square, before);
    at.fresh = nsvcd__v_pick(square, limit, zero, one);
    if (met != nsvcd__v_le(square, limit)) {
      float fresh[NSVCD__SLICE];
      for (size_t k = 0; k < NSVCD__SLICE; k++) fresh[k] = met >> k & 1 ? 0.0f : 1.0f;
      at.fresh = nsvcd__v_load(fresh);
    }
    at.open = met;
    at.last = s;
  }
  if (at.open) nsvcd__intervals_close(&at, at.open, q, i, j, kept);
}
#endif  // NSVCD_NO_NETWORK
