// In: two movers: bodies, scales, pivots, and poses over t in [0,1]. Between poses the position of
// the pivot is linear, the rotation a slerp on the shorter arc. Out: the pose of one body,
// *moving*, in the frame of the other, *fixed*, at any t.
//
// Both may move; "fixed" says whose frame it is. That frame has the axes of the fixed body and
// its scale as the unit, so that its stored numbers need no change: a point x of the moving body is
// at scale R x + p. Positions are subtracted in the world first, so a scene far from the origin
// loses no precision. Poses exactly 180 degrees apart have two shortest arcs: rounding picks one.
//
// Time is counted in *ticks*, of which a motion has a whole number, and so has each body between
// two of its poses: the least common multiple. If poses have times of their own there are at least
// 2^31 ticks, and each time is rounded to the nearest. A *keyframe* is a tick at which either body
// reaches a pose. Between keyframes both motions are smooth.
#pragma once
#include "../ground/motions.h"
#include "../ground/valid.h"
#include "../interface/queries.h"
#include "../body/trust.h"
#include "../ground/rotations.h"
#include "../ground/slices.h"

// The poses of one body.
typedef struct nsvcd__track {
  const nsvcd_pose *poses;  // (count), the caller's
  const float *times;       // (count), the caller's; NULL: uniform, or a single pose
  size_t count;
  uint32_t ticks;  // from a pose to the next; of a single pose all; 0 if there are times
  uint32_t whole;  // ticks of the motion, if there are times
  float scale;
  const float *pivot;  // (3), the caller's; NULL: the origin, or a single pose
} nsvcd__track;

// From the body's origin to its pivot, in the body's axes, metres.
static nsvcd__d3 nsvcd__track_pivot(const nsvcd__track *track) {
  if (!track->pivot) return nsvcd__d3_of(0, 0, 0);
  return nsvcd__d3_scale(nsvcd__d3_load(track->pivot), (double)track->scale);
}

// The tick at which a track's pose k is.
static uint32_t nsvcd__tick_of(const nsvcd__track *track, uint32_t k) {
  if (!track->times) return k * track->ticks;
  return (uint32_t)((double)track->times[k] * (double)track->whole + 0.5);
}

// The last pose at or before a tick, but never the last of several: an arc follows it.
static uint32_t nsvcd__pose_before(const nsvcd__track *track, uint32_t tick) {
  if (track->count == 1) return 0;
  const uint32_t last = (uint32_t)(track->count - 2);
  if (!track->times) {
    const uint32_t k = track->ticks == 1 ? tick : tick / track->ticks;
    return k < last ? k : last;
  }
  uint32_t low = 0;
  uint32_t high = last;
  while (low < high) {
    const uint32_t middle = (low + high + 1) / 2;
    if (nsvcd__tick_of(track, middle) <= tick)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

typedef struct nsvcd__motion {
  nsvcd__track moving, fixed;
  uint32_t ticks;          // in all
  double begin, duration;  // t from begin on: 0 and 1; of one end alone 0 or 1, and 0
  int fixed_moves;
  // The moving body's scale over the fixed one's, as triangles are placed; rounded, as in all that
  // allows for roundings of floats; and its inverse.
  double ratio;
  float scale, per_scale;
  float unit;                // the fixed body's scale, in metres
  nsvcd__f3 fixed_position;  // of the fixed body at t = 0, metres
  // from world axes to the fixed body's at t = 0
  nsvcd__mat3 to_fixed;
  nsvcd__quat to_fixed_quat;
  // added to the moving body's positions, in the fixed body's frame
  nsvcd__f3 push_out;
  // Of an interval: its first tick, and how many arcs a segment has. 0, 0: the whole motion.
  uint32_t from, arcs;
  int is_fine;  // its segments turn by less than usual
} nsvcd__motion;

static nsvcd_result nsvcd__mover_check(const nsvcd_mover *mover) {
  const nsvcd_result result = nsvcd__body_check(mover->body, SIZE_MAX);
  if (result) return result;
  const float scale = mover->scale;
  if (!nsvcd__is_finite(scale) || scale < 0) return NSVCD_ERROR_SCALE;
  if (scale > 0) {
    const float radius = scale * nsvcd__whole_radius(mover->body);
    const float extent = scale * mover->body->extent;
    if (scale < NSVCD_MIN_SCALE || scale > NSVCD_MAX_SCALE) return NSVCD_ERROR_SCALE;
    if (radius < NSVCD_MIN_RADIUS || extent > 2 * NSVCD_MAX_COORDINATE)
      return NSVCD_ERROR_SCALE;
  }
  return nsvcd__track_check(mover);
}

static nsvcd__track nsvcd__track_of(const nsvcd_mover *mover) {
  const size_t count = nsvcd__pose_count(mover);
  const nsvcd_pose *poses = mover->poses ? mover->poses : &nsvcd__at_origin;
  const float *c = mover->pivot;
  const int has_pivot = fabsf(c[0]) + fabsf(c[1]) + fabsf(c[2]) > 0;
  nsvcd__track track = {poses, NULL, count, 0, 0, 1, NULL};
  track.scale = nsvcd__scale_of(mover);
  if (count > 1) track.times = mover->times;
  if (count > 1 && has_pivot) track.pivot = c;
  return track;
}

static uint32_t nsvcd__arc_count(const nsvcd__track *track) {
  return track->count > 1 ? (uint32_t)(track->count - 1) : 1;
}

// Sets the ticks as if all poses were uniform: `parts` times as many as the keyframes need. At most
// 65,535 * 65,534, which fits 32 bits: parts is above 1 only where there are few keyframes.
static void nsvcd__motion_set_ticks(nsvcd__motion *m, uint32_t parts) {
  const uint32_t a = nsvcd__arc_count(&m->moving);
  const uint32_t b = nsvcd__arc_count(&m->fixed);
  uint32_t divisor = a;
  for (uint32_t rest = b; rest;) {
    const uint32_t next = divisor % rest;
    divisor = rest;
    rest = next;
  }
  m->ticks = a / divisor * b * parts;
  m->moving.ticks = m->ticks / a;
  m->fixed.ticks = m->ticks / b;
}

#ifndef NSVCD_NO_PROOF
// Makes ticks finer if there are few. Returns how many a tick becomes.
static double nsvcd__motion_refine(nsvcd__motion *m) {
  uint32_t finer = 1;
  for (; m->ticks < 0x40000000u; m->ticks *= 2) finer *= 2;
  m->moving.ticks *= finer;
  m->fixed.ticks *= finer;
  return (double)finer;
}
#endif

// Sets the ticks if poses have times: the arcs of a uniform body times a power of two, so that its
// poses, and times of few bits, fall on ticks.
static void nsvcd__motion_set_times(nsvcd__motion *m) {
  nsvcd__track *a = &m->moving;
  nsvcd__track *b = &m->fixed;
  if (!a->times && !b->times) return;
  const uint32_t arcs_a = nsvcd__arc_count(a);
  const uint32_t arcs_b = nsvcd__arc_count(b);
  m->ticks = (a->times ? 1 : arcs_a) * (b->times ? 1 : arcs_b);
  while (m->ticks < 0x80000000u) m->ticks *= 2;
  a->whole = b->whole = m->ticks;
  a->ticks = a->times ? 0 : m->ticks / arcs_a;
  b->ticks = b->times ? 0 : m->ticks / arcs_b;
}

// Converts begin (S + 1) from uniform ticks to those of a motion whose poses have times. Segments
// are chosen as if the poses were uniform, for what counts is how far bodies move in one.
static void nsvcd__motion_retime(nsvcd__motion *m, uint32_t *begin, size_t segments) {
  const nsvcd__track *track = m->moving.times ? &m->moving : &m->fixed;
  if (!track->times) return;
  const uint32_t each = track->ticks;
  nsvcd__motion_set_times(m);
  for (size_t s = 0; s < segments; s++) {
    const uint32_t k = begin[s] / each;
    const uint32_t from = nsvcd__tick_of(track, k);
    const uint64_t length = nsvcd__tick_of(track, k + 1) - from;
    begin[s] = from + (uint32_t)(length * (begin[s] - k * each) / each);
  }
  begin[segments] = m->ticks;
}

// The box of the positions of a track's pivot.
static nsvcd__box nsvcd__track_box(const nsvcd__track *track) {
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  nsvcd__box box;
  box.low = box.high = nsvcd__f3_round(nsvcd__pivot_of(track->poses, pivot));
  for (size_t n = 1; n < track->count; n++) {
    const nsvcd__f3 position = nsvcd__f3_round(nsvcd__pivot_of(&track->poses[n], pivot));
    box.low = nsvcd__f3_min(box.low, position);
    box.high = nsvcd__f3_max(box.high, position);
  }
  return box;
}

// A lower bound of the distance between the pivots of bodies on two tracks, in units: they never
// leave the boxes of their positions.
static float nsvcd__tracks_gap(const nsvcd__track *moving, const nsvcd__track *fixed,
                               float unit) {
  const nsvcd__box a = nsvcd__track_box(moving);
  const nsvcd__box b = nsvcd__track_box(fixed);
  const nsvcd__f3 above = nsvcd__f3_sub(a.low, b.high);
  const nsvcd__f3 below = nsvcd__f3_sub(b.low, a.high);
  const nsvcd__f3 none = nsvcd__f3_of(0, 0, 0);
  const nsvcd__f3 gap = nsvcd__f3_max(nsvcd__f3_max(above, below), none);
  return 0.99999f * nsvcd__f3_norm(gap) / unit;
}

// How far a body's pivot is from its origin, in units.
static float nsvcd__pivot_arm(const nsvcd__motion *m, const nsvcd__track *track) {
  if (!track->pivot) return 0;
  return nsvcd__above(nsvcd__d3_norm(nsvcd__track_pivot(track)) / (double)m->unit);
}
static float nsvcd__pivot_arms(const nsvcd__motion *m) {
  return nsvcd__pivot_arm(m, &m->moving) + nsvcd__pivot_arm(m, &m->fixed);
}

static float nsvcd__motion_gap(const nsvcd__motion *m) {
  return nsvcd__tracks_gap(&m->moving, &m->fixed, m->unit);
}

// Sets all that follows from the tracks.
static void nsvcd__motion_set_tracks(nsvcd__motion *m, nsvcd__track moving,
                                     nsvcd__track fixed) {
  if (moving.count == 1) moving.pivot = NULL;
  if (fixed.count == 1) fixed.pivot = NULL;
  m->moving = moving;
  m->fixed = fixed;
  m->fixed_moves = fixed.count > 1;
  nsvcd__motion_set_ticks(m, 1);
  nsvcd__motion_set_times(m);
  m->from = m->arcs = 0;
  m->is_fine = 0;

  const nsvcd_pose *first = fixed.poses;
  const nsvcd__quat q = nsvcd__quat_unit(nsvcd__quat_load(first->rotation));
  m->to_fixed = nsvcd__mat3_transpose(nsvcd__mat3_of(q));
  m->to_fixed_quat = nsvcd__quat_inverse(q);
  m->fixed_position = nsvcd__f3_load(first->position);
}

// The motion of valid movers, whose poses it points to.
static void nsvcd__motion_init(const nsvcd_mover *moving, const nsvcd_mover *fixed,
                               nsvcd__motion *m) {
  m->unit = nsvcd__scale_of(fixed);
  m->ratio = (double)nsvcd__scale_of(moving) / (double)m->unit;
  m->scale = (float)m->ratio;
  m->per_scale = 1 / m->scale;
  m->push_out = nsvcd__f3_of(0, 0, 0);
  m->begin = 0;
  m->duration = 1;
  nsvcd__motion_set_tracks(m, nsvcd__track_of(moving), nsvcd__track_of(fixed));
}

// A body's rotation in the world, unit to 1e-4, and the position of its pivot, metres. In double,
// because on a long path past the other body rounding its ends would be large beside the clearance.
typedef struct nsvcd__world_pose {
  nsvcd__quat rotation;
  nsvcd__d3 position;
} nsvcd__world_pose;

static nsvcd__world_pose nsvcd__world_pose_of(const nsvcd_pose *pose, nsvcd__d3 pivot) {
  const nsvcd__world_pose out = {nsvcd__quat_load(pose->rotation),
                                 nsvcd__pivot_of(pose, pivot)};
  return out;
}

// The pose at a fraction between two.
static nsvcd__world_pose nsvcd__world_pose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                   nsvcd__d3 pivot, double fraction) {
  const nsvcd__world_pose from = nsvcd__world_pose_of(a, pivot);
  const nsvcd__world_pose to = nsvcd__world_pose_of(b, pivot);
  nsvcd__world_pose out;
  out.rotation = nsvcd__quat_slerp(from.rotation, to.rotation, (float)fraction);
  out.position = nsvcd__d3_mix(from.position, to.position, fraction);
  return out;
}

// A track's pose at a tick.
static nsvcd__world_pose nsvcd__track_pose(const nsvcd__track *track, uint32_t tick) {
  const uint32_t k = nsvcd__pose_before(track, tick);
  const nsvcd_pose *a = &track->poses[k];
  const uint32_t from = nsvcd__tick_of(track, k);
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  if (tick == from || track->count == 1) return nsvcd__world_pose_of(a, pivot);
  const uint32_t to = nsvcd__tick_of(track, k + 1);
  if (tick == to) return nsvcd__world_pose_of(a + 1, pivot);
  const double fraction = (double)(tick - from) / (double)(to - from);
  return nsvcd__world_pose_between(a, a + 1, pivot, fraction);
}

// The tick of a track's next pose after a tick that is not the last.
static uint32_t nsvcd__next_pose(const nsvcd__track *track, uint32_t tick) {
  return nsvcd__tick_of(track, nsvcd__pose_before(track, tick) + 1);
}

// The keyframe after a tick.
static uint32_t nsvcd__next_keyframe(const nsvcd__motion *m, uint32_t tick) {
  if (m->moving.ticks == 1 || m->fixed.ticks == 1) return tick + 1;
  const uint32_t after_a = nsvcd__next_pose(&m->moving, tick);
  const uint32_t after_b = nsvcd__next_pose(&m->fixed, tick);
  return after_a < after_b ? after_a : after_b;
}

#ifndef NSVCD_NO_NETWORK
// The pose of a moving track before time t in [0,1], and the fraction of the arc after it. Uniform
// tracks are not rounded to ticks: derivatives by t need all that floats resolve.
static size_t nsvcd__pose_at(const nsvcd__track *track, float t, float *fraction) {
  if (track->times) {
    const double tick = (double)t * (double)track->whole;
    const uint32_t k = nsvcd__pose_before(track, (uint32_t)tick);
    const float from = track->times[k];
    *fraction = (t - from) / (track->times[k + 1] - from);
    return k;
  }
  const size_t last = track->count - 2;
  const float at = t * (float)(last + 1);
  const size_t k = (size_t)at < last ? (size_t)at : last;
  *fraction = at - (float)k;
  return k;
}
#endif
