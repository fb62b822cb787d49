// In: a motion. Out: its segments: how many, when they begin, and their poses and deviations.
//
// A motion that is too long for one search is cut into *intervals*, each of which is searched with
// segments of its own: else a segment would hold hundreds of poses, or turn by hundreds of degrees,
// and separate nothing. An interval begins at a keyframe. It has as many arcs as there is room for:
// one in each segment, or one in several where it turns a lot. A *try* is larger: several arcs in
// each segment, and a small budget tells whether all of it is easy.
#pragma once
#include "workspace.h"

#define NSVCD__SEGMENT_TURN 0.349f  // radians, 20 degrees
#define NSVCD__FINE_TURN 0.131f     // 7.5 degrees: shorter segments gain nothing

// Upper bounds of the sum of a track's arcs of rotation, radians, and of the longest: as in
// nsvcd__v_arc.
static void nsvcd__measure_turn(const nsvcd__track *track, float *turn, float *widest) {
  *turn = *widest = 0;
  for (size_t n = 1; n < track->count; n++) {
    const nsvcd__quat a = nsvcd__quat_load(track->poses[n - 1].rotation);
    const nsvcd__quat b = nsvcd__quat_load(track->poses[n].rotation);
    const float sign = nsvcd__quat_dot(a, b) < 0 ? 1.0f : -1.0f;
    const nsvcd__quat chord = nsvcd__quat_fma(sign, b, a);
    const float x = 0.50025f * sqrtf(nsvcd__quat_dot(chord, chord));
    const float arc = x * (4 + 2.2832f * x * x);
    *turn += arc;
    *widest = arc > *widest ? arc : *widest;
  }
}

// How many segments. They begin at ticks; if there are too few of these, each is cut into `parts`,
// else 1.
static size_t nsvcd__segment_count(const nsvcd__motion *m, size_t greatest, uint32_t *parts) {
  const size_t ticks = m->ticks;
  float turn, widest, fixed_turn, fixed_widest;
  *parts = 1;
  if (m->moving.count == 1 && !m->fixed_moves) return 1;
  nsvcd__measure_turn(&m->moving, &turn, &widest);
  nsvcd__measure_turn(&m->fixed, &fixed_turn, &fixed_widest);
  turn = turn + fixed_turn < 1e3f ? turn + fixed_turn : 1e3f;
  const size_t coarse = (size_t)ceilf(turn / NSVCD__SEGMENT_TURN);
  const size_t fine = (size_t)ceilf(turn / NSVCD__FINE_TURN);
  size_t wanted = fine < NSVCD__SEGMENTS ? fine : NSVCD__SEGMENTS;
  if (wanted < coarse) wanted = coarse < greatest ? coarse : greatest;
  if (wanted < 1) wanted = 1;
  if (ticks > wanted) {
    const size_t enough = wanted < NSVCD__SEGMENTS ? NSVCD__SEGMENTS : wanted;
    return ticks < enough ? ticks : enough;
  }
  const float of_tick = widest / (float)m->moving.ticks + fixed_widest / (float)m->fixed.ticks;
  const size_t least = (size_t)ceilf(of_tick / NSVCD__SEGMENT_TURN);
  const size_t most = greatest / ticks;
  size_t each = wanted / ticks > least ? wanted / ticks : least;
  each = each < most ? each : most;
  *parts = (uint32_t)(each > 1 ? each : 1);
  return ticks * *parts;
}

// The segments of a whole motion: equally many ticks in each, to one.
static void nsvcd__choose_in_all(nsvcd__motion *m, nsvcd__search *q) {
  uint32_t parts;
  nsvcd__motion_set_ticks(m, 1);
  q->segments = nsvcd__segment_count(m, q->most_segments, &parts);
  nsvcd__motion_set_ticks(m, parts);
  const uint32_t segments = (uint32_t)q->segments;
  const uint32_t each = m->ticks / segments;
  const uint32_t over = m->ticks % segments;
  for (uint32_t s = 0; s <= segments; s++) q->begin[s] = each * s + over * s / segments;
  nsvcd__motion_retime(m, q->begin, segments);
}

// Sets the ticks of a motion that is cut into intervals: the same for all of them, and so many that
// an arc can be cut.
static void nsvcd__motion_set_fine_ticks(nsvcd__motion *m) {
  uint32_t parts = NSVCD__MAX_SEGMENTS;
  nsvcd__motion_set_ticks(m, 1);
  while (m->ticks > 0xffffffffu / parts) parts /= 2;
  nsvcd__motion_set_ticks(m, parts);
  nsvcd__motion_set_times(m);
}

// How far a track turns between ticks of the same arc: about, radians.
static float nsvcd__track_turn(const nsvcd__track *track, uint32_t from, uint32_t to) {
  if (track->count == 1) return 0;
  const uint32_t k = nsvcd__pose_before(track, from);
  const nsvcd__quat a = nsvcd__quat_load(track->poses[k].rotation);
  const nsvcd__quat b = nsvcd__quat_load(track->poses[k + 1].rotation);
  const float cosine = fabsf(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w);
  const float chord = sqrtf(2 * (cosine < 1 ? 1 - cosine : 0));
  const uint32_t length = nsvcd__tick_of(track, k + 1) - nsvcd__tick_of(track, k);
  return (2 + 0.1f * chord * chord) * chord * (float)(to - from) / (float)length;
}

// The segments of an interval.
static void nsvcd__choose_in_interval(nsvcd__motion *m, nsvcd__search *q) {
  const size_t most = q->most_segments;
  const int is_try = m->arcs > 1;
  const float step = m->is_fine ? NSVCD__FINE_TURN : NSVCD__SEGMENT_TURN;
  size_t segments = 0;
  nsvcd__motion_set_fine_ticks(m);
  q->begin[0] = m->from;
  while (segments < most && q->begin[segments] < m->ticks) {
    const uint32_t from = q->begin[segments];
    uint32_t to = from;
    for (uint32_t n = 0; n < m->arcs && to < m->ticks; n++) to = nsvcd__next_keyframe(m, to);
    const float turn =
        nsvcd__track_turn(&m->moving, from, to) + nsvcd__track_turn(&m->fixed, from, to);
    const float steps = ceilf(turn / step - 0.1f);
    const size_t turns = is_try || !(steps > 1) ? 1 : (size_t)steps;
    if (segments > 0 && segments + turns > most) break;
    const uint32_t parts = (uint32_t)(turns < most ? turns : most);
    const uint64_t length = to - from;
    for (uint32_t n = 1; n <= parts; n++)
      q->begin[++segments] = from + (uint32_t)(length * n / parts);
  }
  q->segments = segments;
}

// Chooses how many segments there are, and when they begin.
static void nsvcd__choose_segments(nsvcd__motion *m, nsvcd__search *q) {
  if (m->arcs > 0)
    nsvcd__choose_in_interval(m, q);
  else
    nsvcd__choose_in_all(m, q);
  q->scale = m->scale;
  const double per_tick = 1 / (double)m->ticks;
  for (size_t s = 0; s <= q->segments; s++)
    q->time[s] = (float)((double)q->begin[s] * per_tick);
}

// ---- intervals

static void nsvcd__choose_all(nsvcd__motion *m, nsvcd__search *q) {
  m->from = m->arcs = 0;
  m->is_fine = 0;
  nsvcd__choose_segments(m, q);
}

#ifndef NSVCD_NO_PROOF
// The tick of a position counted in segments: 1.5 is in the middle of the second.
static double nsvcd__tick_in_segments(const uint32_t *begin, double at) {
  const size_t s = (size_t)at;
  const double start = (double)begin[s];
  const double fraction = at - (double)s;
  return fraction > 0 ? start + fraction * ((double)begin[s + 1] - start) : start;
}

// Leaves the part of the segments between two positions, in ticks so many times finer.
static void nsvcd__narrow_segments(nsvcd__search *q, double from, double to, double finer) {
  uint32_t *begin = q->begin;
  const double start = nsvcd__tick_in_segments(begin, from);
  const double end = nsvcd__tick_in_segments(begin, to);
  const size_t first = (size_t)from;
  const size_t last = (size_t)to;
  q->segments = last - first + (to > (double)last);
  for (size_t s = 1; s < q->segments; s++)
    begin[s] = (uint32_t)(finer * (double)begin[first + s]);
  begin[0] = (uint32_t)(finer * start);
  begin[q->segments] = (uint32_t)(finer * end);
}

// An upper bound of the keyframes after a tick.
static size_t nsvcd__keyframes_after(const nsvcd__motion *m, uint32_t tick) {
  const size_t moving = m->moving.count - 1 - nsvcd__pose_before(&m->moving, tick);
  const size_t fixed = m->fixed.count - 1 - nsvcd__pose_before(&m->fixed, tick);
  return moving + fixed;
}

// Chooses the segments of the interval that begins at a tick, with so many arcs in each, or fewer
// at the end of the motion.
static void nsvcd__choose_interval(nsvcd__motion *m, nsvcd__search *q, uint32_t from,
                                   uint32_t arcs) {
  const size_t most = q->most_segments;
  const size_t left = (nsvcd__keyframes_after(m, from) + most - 1) / most;
  m->from = from;
  m->arcs = arcs < left ? arcs : (uint32_t)left;
  nsvcd__choose_segments(m, q);
}

// Is a motion too long for one search? If not, chooses its segments.
static int nsvcd__is_long(nsvcd__motion *m, nsvcd__search *q) {
  const size_t most = q->most_segments;
  const size_t keyframes = nsvcd__keyframes_after(m, 0);
  if (keyframes <= most) {
    nsvcd__choose_all(m, q);
    if (keyframes < 2 || q->segments < most) return 0;
  }
  nsvcd__choose_interval(m, q, 0, 1);
  if (q->begin[q->segments] < m->ticks) return 1;
  nsvcd__choose_all(m, q);
  return 0;
}

// The poses of a track in an interval, without ticks of their own.
static nsvcd__track nsvcd__subtrack(const nsvcd__track *track, uint32_t from, uint32_t until) {
  nsvcd__track part = *track;
  const uint32_t first = nsvcd__pose_before(track, from);
  if (track->count == 1) return part;
  part.poses += first;
  part.count = nsvcd__pose_before(track, until - 1) + 2 - first;
  return part;
}

// nsvcd__motion_gap of an interval.
static float nsvcd__interval_gap(const nsvcd__motion *m, uint32_t from, uint32_t until) {
  const nsvcd__track moving = nsvcd__subtrack(&m->moving, from, until);
  const nsvcd__track fixed = nsvcd__subtrack(&m->fixed, from, until);
  return nsvcd__tracks_gap(&moving, &fixed, m->unit);
}
#endif
