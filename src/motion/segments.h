// In: a motion. Out: segments of time, and chords of spheres in them, grown so that the sphere is
// covered all the way: the broad phase is built on that. Conservative: spheres that meet at a time
// have chords that meet there, and if no chords do, the surfaces never meet, and that is a proof.
//
// Time is cut into S segments. Within one, every sphere centre c of the moving body (its frame) is
// taken along the chord between its places at the two ends, x0 + tau v, tau in [0,1], and the
// radius grows by
//   dev(c) = margin + bend |c|
// so that it covers the true place (M(t) c + p(t)) at every t, M being the rotation times the
// scale. Why: let L(t) be the linear interpolation of M between the segment's ends, K(t) the
// piecewise linear one through the keyframes inside. Between two keyframes a chord misses a curve
// by at most max|second derivative| / 8, with time from 0 to 1 there. Where only one body moves,
// that is h^2 |c| / 8 on an arc of angle h, and its origin goes straight. Where both do, what the
// fixed body sees bends more: nsvcd__cut_double_arc. K - L is piecewise linear, its norm convex, so
// it is largest at a keyframe. Hence
//   bend   = max over arcs of what they bend by per metre
//                      + max over keyframes ||M_k - L(t_k)||  (Frobenius >= 2-norm)
//   origin_bend = max over arcs of what the origin bends by
//                      + max over keyframes |p_k - its linear interpolation|
//   margin           = origin_bend + rounding + the clearance that is asked for
// Along a direction n, |n| <= 1, it is less. A turn by h about the unit axis a bends the way of a
// point x by a x (a x y) h^2, y being x, turned; and n.(a x (a x y)) = (n x a).(a x y), which is no
// more than |n x a| |x|: nothing along the axis. So `bend_along_axis` and
// `origin_along_axis` are what is left along the axis of the whole segment's turn, off
// which the arcs' axes may be, and nsvcd__deviation_of puts them together.
//
// A group or a whole body is a sphere like any other: its sphere, truly posed, contains its
// members', truly posed.
//
// Hierarchy: body x body; groups near the body, in boxes, x groups; group x group; group x 16
// spheres; 16 spheres x sphere. But for the boxes every step is the same test, moving spheres on
// chords against resting spheres; the lanes are segments, or members of a group. A step of the
// search is a pair of groups. Moving groups that meet most come first, and of each the group that
// it meets longest, because a deep collision is then found before the rest is searched.
//
// A *tile* is up to 32 groups of one body and up to 32 of the other, which are searched together.
// Bodies of up to 512 patches make one tile. Of larger ones, a traversal of the levels of spheres
// above the groups finds those that the other body comes near, and they are searched tile after
// tile: each moving tile against all tiles of the fixed body.
#pragma once
#include "../ground/memory.h"
#include "../body/traversal.h"
#include "motion.h"

// of a motion, as long as none then turns by more than NSVCD__SEGMENT_TURN
#define NSVCD__SEGMENTS 16
// reached at 1280 degrees: what turns more is cut into intervals (motion/choice)
#define NSVCD__MAX_SEGMENTS 64
#define NSVCD__SEGMENT_TURN 0.349f  // radians, 20 degrees
#define NSVCD__FINE_TURN 0.131f     // 7.5 degrees: nothing is gained by shorter segments
// radians, 45 degrees: an interval is cut before it turns more, for the decoder's twist
#define NSVCD__INTERVAL_TURN 0.785f
#define NSVCD__BLOCKS (NSVCD__MAX_SEGMENTS / NSVCD__LANES)
// Of the lengths that go into a difference of places: about 15 float operations of 6e-8 each,
// doubled.
#define NSVCD__ROUNDING 2e-6f

// A contact interval: the patches `moving` and `fixed` overlap from t_enter to t_exit (both with
// the deviation added).
typedef struct nsvcd__candidate {
  uint16_t moving, fixed;
  float t_enter, t_exit;
  float t_least;  // where the gap is least
  // rank, 1 - least distance / (r1 + r2): the deepest go on to the network
  float depth;
  // what the network says: a logit, or NSVCD__NO_SCORE; and a distance, in tenths of r1 + r2
  float score, apart;
} nsvcd__candidate;

#define NSVCD__NO_SCORE (-1e30f)

// Chords start + tau way of 16 moving spheres, their radii plus deviation, and -1 / |way|^2.
typedef struct nsvcd__chords {
  float start[3][NSVCD__LANES];
  float travel[3][NSVCD__LANES];
  float inverse[NSVCD__LANES];
  float radius[NSVCD__LANES];
} nsvcd__chords;

// 16 segments: pose at the start, change of the pose until the end, deviation.
typedef struct nsvcd__segments {
  float rotation[9][NSVCD__LANES], position[3][NSVCD__LANES], turned[9][NSVCD__LANES],
      moved[3][NSVCD__LANES];
  float margin[NSVCD__LANES], bend[NSVCD__LANES];
  // For the proof, the same along directions: see nsvcd__deviation_of.
  float rounding[NSVCD__LANES], origin_bend[NSVCD__LANES], axis[3][NSVCD__LANES],
      bend_along_axis[NSVCD__LANES];
  float origin_along_axis[NSVCD__LANES], heading[3][NSVCD__LANES],
      origin_off_heading[NSVCD__LANES];
} nsvcd__segments;

// Poses of both bodies at 16 ticks, and one more, in the world; and quaternions as the fixed body
// sees them.
#define NSVCD__KEYFRAMES (NSVCD__LANES + 1)
typedef struct nsvcd__keyframes {
  // (4, KEYFRAMES) quaternions, as the next two
  float moving[4 * NSVCD__KEYFRAMES];
  float fixed[4 * NSVCD__KEYFRAMES];
  float seen[4 * NSVCD__KEYFRAMES];
  // (3, KEYFRAMES) see nsvcd__v_poses
  float offset[3 * NSVCD__KEYFRAMES];
} nsvcd__keyframes;

// What is kept of 16 segments while their keyframes are visited, lane by lane.
typedef struct nsvcd__bends {
  float sum[NSVCD__LANES];  // of the turns of arcs
  // The greatest so far of what arcs leave their chords by: per metre from the moving body's
  // origin, along the axis too, and that origin itself.
  float arc_bend[NSVCD__LANES], arc_bend_along_axis[NSVCD__LANES], arc_origin[NSVCD__LANES];
  // The greatest so far, squared, of what keyframes are off their chord by: the rotation and the
  // position, and both along the axis, or across the way.
  float bend[NSVCD__LANES], margin[NSVCD__LANES], keyframe_bend_along_axis[NSVCD__LANES],
      keyframe_origin_along_axis[NSVCD__LANES];
  float keyframe_origin_off_heading[NSVCD__LANES];
} nsvcd__bends;

typedef struct nsvcd__cut {
  // read now, the ones before, and those at the segments' ends
  nsvcd__keyframes here, last, end;
  nsvcd__bends most;
} nsvcd__cut;

// 16 boxes, as their least and greatest coordinates.
typedef struct nsvcd__boxes {
  float low[3][NSVCD__LANES], high[3][NSVCD__LANES];
} nsvcd__boxes;

// Groups that are searched together: their numbers and spheres. Lanes without a group have r =
// NSVCD__NOWHERE.
typedef struct nsvcd__tile {
  size_t count;
  uint16_t groups[NSVCD__TILE_SLOTS];
  // the body's own where it has no more than a tile, else gathered
  nsvcd__spheres spheres;
  // (4, NSVCD__TILE_SLOTS), or NULL
  float *gathered;
} nsvcd__tile;

// What a query needs memory for.
typedef struct nsvcd__needs {
  size_t moving_groups, fixed_groups;  // of a tile
  // a body has more than these
  int large;
  // 16, 32, 48 or 64
  size_t segments;
  // of the network
  size_t candidates;
  int proof;
} nsvcd__needs;

typedef struct nsvcd__search {
  const nsvcd_body *moving, *fixed;
  size_t segments;  // S
  // that there is room for
  size_t most_segments;
  float scale;  // of the moving body
  // (S + 1) ticks at which they begin, then the last one
  uint32_t *begin;
  float *time;  // (S + 1) of the ends of the segments
  // (S + 1) rotation arc from t = 0 to there, radians
  float *turn;
  nsvcd__segments *blocks;  // (S / 16 rounded up)
  // (S / 16 rounded up) a moving group's
  nsvcd__chords *group;
  nsvcd__chords *members;  // (S) its 16 members', per segment
  // in the same place: segments are cut before any search
  nsvcd__cut *cut;
  uint64_t near_segments;  // in which the bodies' spheres meet
  // through the groups that come near; where a body is large
  nsvcd__traversal moving_traversal, fixed_traversal;
  nsvcd__box near_box;  // about the way of the moving tile
  // the groups that are searched now; below, places in these
  nsvcd__tile moving_tile, fixed_tile;
  // (moving groups, fixed groups) segments in which they meet
  uint64_t *nearby;
  size_t nearby_stride;  // see nsvcd__nearby
  // segments to search; all, but where contacts are sought in order
  uint64_t wanted;
  // moving groups that are near any, in the order of the search
  uint16_t order[NSVCD__TILE_SLOTS];
  // how many they are, and which of them is being searched
  size_t steps, step;
  // fixed groups that it has yet to be searched against, and which of them is next
  uint32_t waiting;
  size_t at;
  uint64_t posed;  // segments for which members[] is filled
  // no part of these members is farther from the body's origin
  float extent;
#ifndef NSVCD_NO_NETWORK
  // what is known of planes that part patches, and (GROUP, S) lanes of a group that meet each of
  // another: search/apart
  struct nsvcd__plane_cache *cache;
  uint16_t *met;
  // 0: no patches' balls meet, which certifies free
  int balls_met;
#endif
} nsvcd__search;

// Vectors that cross cache lines take longer: the arrays of 16 lanes begin with one, where there
// are vectors. For that so many bytes are passed over at most, and counted where base is NULL.
#define NSVCD__PASSED_OVER (NSVCD__SLICE > 1 ? 64 - NSVCD_ALIGNMENT : 0)
static void nsvcd__take_to_line(char *base, uint64_t *used) {
  if (NSVCD__PASSED_OVER == 0) return;
  *used += base ? (0 - (uintptr_t)(base + *used)) & 63 : NSVCD__PASSED_OVER;
}

// Lays a workspace out in base, or, where that is NULL, only counts.
static void nsvcd__search_layout(const nsvcd__needs *needs, char *base, uint64_t *used,
                                 nsvcd__search *search) {
  const size_t s = needs->segments;
  const size_t blocks = s / NSVCD__LANES;
  const size_t members = s * sizeof(nsvcd__chords);
  const size_t gathered = needs->large ? 4 * NSVCD__TILE_SLOTS : 0;
  search->most_segments = s;
  search->begin = (uint32_t *)nsvcd__take(base, used, s + 1, sizeof(uint32_t));
  search->time = (float *)nsvcd__take(base, used, s + 1, sizeof(float));
  search->turn = (float *)nsvcd__take(base, used, s + 1, sizeof(float));
  nsvcd__take_to_line(base, used);
  search->blocks = (nsvcd__segments *)nsvcd__take(base, used, blocks, sizeof(nsvcd__segments));
  search->group = (nsvcd__chords *)nsvcd__take(base, used, blocks, sizeof(nsvcd__chords));
  search->members = (nsvcd__chords *)nsvcd__take(
      base, used, 1, members > sizeof(nsvcd__cut) ? members : sizeof(nsvcd__cut));
  search->cut = (nsvcd__cut *)(void *)search->members;
  search->nearby_stride = needs->fixed_groups;
  search->nearby = (uint64_t *)nsvcd__take(
      base, used, needs->moving_groups * needs->fixed_groups, sizeof(uint64_t));
  search->moving_tile.gathered = (float *)nsvcd__take(base, used, gathered, sizeof(float));
  search->fixed_tile.gathered = (float *)nsvcd__take(base, used, gathered, sizeof(float));
}

// Memory for chords, and for boxes: where the members of a group will be posed later.
static nsvcd__chords *nsvcd__spare_chords(const nsvcd__search *search) {
  return &search->members[0];
}
static nsvcd__boxes *nsvcd__spare_boxes(const nsvcd__search *search) {
  return (nsvcd__boxes *)(void *)&search->members[1];
}

// The segments in which group g of the moving tile meets each one of the fixed tile.
static uint64_t *nsvcd__nearby(const nsvcd__search *search, size_t g) {
  return search->nearby + g * search->nearby_stride;
}

// Not less than the angle between two rotations, unit to 1e-4, and hardly more where it is small: 4
// asin(chord / 2) of their chord as quaternions, asin x <= x + (pi/2 - 1) x^3, and half a
// thousandth for the lengths. chord2: its square.
static nsvcd__v nsvcd__v_arc_bound(nsvcd__v chord2) {
  const nsvcd__v x = nsvcd__v_scale(nsvcd__v_sqrt(chord2), 0.50025f);
  const nsvcd__v square = nsvcd__v_mul(x, x);
  return nsvcd__v_mul(x, nsvcd__v_fma(nsvcd__v_set(2.2832f), square, nsvcd__v_set(4)));
}

// The vector part of b a^-1, of two quaternions: the axis of the turn from a to b, times the sine
// of half its angle.
static nsvcd__v3 nsvcd__v_turn_between(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v3 u = nsvcd__vquat_axis(a);
  const nsvcd__v3 v = nsvcd__vquat_axis(b);
  const nsvcd__v3 sum = nsvcd__v3_fma(nsvcd__v_negate(b.w), u, nsvcd__v3_cross(u, v));
  return nsvcd__v3_fma(a.w, v, sum);
}

// 1 where x >= 0, else -1.
static nsvcd__v nsvcd__v_sign(nsvcd__v x) {
  return nsvcd__v_pick(nsvcd__v_set(0), x, nsvcd__v_set(1), nsvcd__v_set(-1));
}

// The same on the shorter arc. cosine: of half the angle; near 0, rounding may have taken the
// longer one.
static nsvcd__v3 nsvcd__v_shorter_turn_between(nsvcd__vquat a, nsvcd__vquat b,
                                               nsvcd__v *cosine) {
  const nsvcd__v dot = nsvcd__vquat_dot(a, b);
  const nsvcd__v sign = nsvcd__v_sign(dot);
  *cosine = nsvcd__v_mul(sign, dot);
  return nsvcd__v3_scale(nsvcd__v_turn_between(a, b), sign);
}

// Reads the poses of both bodies at the first `count` of these ticks; where one body moves and
// every tick is one of its poses, as the caller gave them.
static void nsvcd__keyframes_read(const nsvcd__motion *motion, const uint32_t *ticks,
                                  size_t count, nsvcd__keyframes *out) {
  const nsvcd__track *track = &motion->moving;
  const int as_given = track->ticks == 1 && track->count > 1 && !motion->fixed_moves;
  nsvcd__world_pose fixed = {{0, 0, 0, 1}, nsvcd__d3_widen(motion->fixed_position)};
  for (size_t l = 0; l < count; l++) {
    nsvcd__quat rotation;
    nsvcd__f3 offset;
    if (as_given) {
      const nsvcd_pose *pose = &track->poses[ticks[l]];
      rotation = nsvcd__quat_load(pose->rotation);
      offset = nsvcd__f3_sub(nsvcd__f3_load(pose->position), motion->fixed_position);
    } else {
      const nsvcd__world_pose moving = nsvcd__track_pose(track, ticks[l]);
      if (motion->fixed_moves) fixed = nsvcd__track_pose(&motion->fixed, ticks[l]);
      rotation = moving.rotation;
      offset = nsvcd__d3_narrow(nsvcd__d3_sub(moving.position, fixed.position));
      if (motion->fixed_moves)
        nsvcd__quat_put(fixed.rotation, out->fixed + l, NSVCD__KEYFRAMES);
    }
    nsvcd__f3_put(offset, out->offset + l, NSVCD__KEYFRAMES);
    nsvcd__quat_put(rotation, out->moving + l, NSVCD__KEYFRAMES);
  }
}

// A slice of them, from the one in lane `first` on, up to LANES - SLICE + 1: there is one keyframe
// more than lanes.
static nsvcd__v_poses nsvcd__keyframes_load(const nsvcd__motion *motion,
                                            const nsvcd__keyframes *from, size_t first) {
  nsvcd__v_poses out;
  out.offset = nsvcd__v3_load_rows(from->offset + first, NSVCD__KEYFRAMES);
  out.moving = nsvcd__vquat_load(from->moving + first, NSVCD__KEYFRAMES);
  out.fixed = out.moving;
  if (motion->fixed_moves) {
    out.moving = nsvcd__vquat_unit(out.moving);
    out.fixed = nsvcd__vquat_unit(nsvcd__vquat_load(from->fixed + first, NSVCD__KEYFRAMES));
  }
  return out;
}

// `seen`: the quaternions as the fixed body sees them. l: the slice's first lane, here and below.
static void nsvcd__keyframes_keep(const nsvcd__motion *motion, const nsvcd__v_poses *at,
                                  nsvcd__vquat seen, size_t l, nsvcd__keyframes *out) {
  nsvcd__vquat_store(at->moving, out->moving + l, NSVCD__KEYFRAMES);
  nsvcd__vquat_store(seen, out->seen + l, NSVCD__KEYFRAMES);
  if (!motion->fixed_moves) return;
  nsvcd__v3_store_rows(at->offset, out->offset + l, NSVCD__KEYFRAMES);
  nsvcd__vquat_store(at->fixed, out->fixed + l, NSVCD__KEYFRAMES);
}

// A bound of the angle between two unit quaternions, lane by lane.
static nsvcd__v nsvcd__v_arc(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__vquat_dot(a, b));
  const nsvcd__v x = nsvcd__v_sub(nsvcd__v_mul(sign, b.x), a.x);
  const nsvcd__v y = nsvcd__v_sub(nsvcd__v_mul(sign, b.y), a.y);
  const nsvcd__v z = nsvcd__v_sub(nsvcd__v_mul(sign, b.z), a.z);
  const nsvcd__v w = nsvcd__v_sub(nsvcd__v_mul(sign, b.w), a.w);
  const nsvcd__vquat chord = {x, y, z, w};
  return nsvcd__v_arc_bound(nsvcd__vquat_dot(chord, chord));
}

// A bound of h^2 / 8 |axis x a|, of a turn by h (arc: a bound of it) about a: with w = a sin(h / 2)
// that is no more than pi / 8 h |axis x w|.
static nsvcd__v nsvcd__v_turn_off_axis(nsvcd__v3 axis, nsvcd__vquat from, nsvcd__vquat to,
                                       nsvcd__v arc) {
  const nsvcd__v3 across = nsvcd__v3_cross(axis, nsvcd__v_turn_between(from, to));
  return nsvcd__v_mul(nsvcd__v_scale(arc, 0.3931f), nsvcd__v3_length(across));
}

// most, sum: of the slice.
static void nsvcd__v_keep_most(float *most, nsvcd__v value) {
  nsvcd__v_store(most, nsvcd__v_max(nsvcd__v_load(most), value));
}
static void nsvcd__v_add_to(float *sum, nsvcd__v value) {
  nsvcd__v_store(sum, nsvcd__v_add(nsvcd__v_load(sum), value));
}

// Poses at the starts of 16 segments, whose ticks are begin[0..16]. Starts the visit of the
// keyframes within.
static NSVCD__NOINLINE void nsvcd__cut_starts(const nsvcd__motion *motion,
                                              const uint32_t *begin, nsvcd__segments *out,
                                              nsvcd__cut *cut) {
  const nsvcd__v scale = nsvcd__v_set(motion->scale);
  memset(&cut->most, 0, sizeof cut->most);
  nsvcd__keyframes_read(motion, begin, NSVCD__KEYFRAMES, &cut->here);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(motion, &cut->here, l);
    const nsvcd__v_pose seen = nsvcd__v_seen(motion, &at);
    const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
    nsvcd__keyframes_keep(motion, &at, seen.rotation, l, &cut->last);
    nsvcd__vmat3_store(out->rotation, l, nsvcd__vmat3_scale(rotation, scale));
    nsvcd__v3_store(out->position, l, seen.position);
  }
}

// The same at their ends; the starts are known.
static NSVCD__NOINLINE void nsvcd__cut_ends(const nsvcd__motion *motion, nsvcd__segments *out,
                                            nsvcd__cut *cut) {
  const nsvcd__v scale = nsvcd__v_set(motion->scale);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(motion, &cut->here, l + 1);
    const nsvcd__v_pose seen = nsvcd__v_seen(motion, &at);
    const nsvcd__vmat3 end = nsvcd__vmat3_scale(nsvcd__vmat3_of(seen.rotation), scale);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__v3 moved = nsvcd__v3_sub(seen.position, nsvcd__v3_load(out->position, l));
    const nsvcd__vquat seen_first = nsvcd__vquat_load(cut->last.seen + l, NSVCD__KEYFRAMES);
    const nsvcd__v3 turn = nsvcd__v_turn_between(seen_first, seen.rotation);
    nsvcd__keyframes_keep(motion, &at, seen.rotation, l, &cut->end);
    nsvcd__vmat3_store(out->turned, l, nsvcd__vmat3_sub(end, start));
    nsvcd__v3_store(out->moved, l, moved);
    nsvcd__v3_store(out->axis, l, nsvcd__v3_unit(turn));
    nsvcd__v3_store(out->heading, l, nsvcd__v3_unit(moved));
  }
}

// Of arcs in which both bodies move. With w and w' the rotation vectors of the moving and the fixed
// body over the arc, in the world, o = w - w', and d the way from the fixed origin to the moving
// one, which goes by v, the second derivative of what the fixed body sees of a point x is, in its
// axes,
//   o x (o x Rx) + (o x w') x Rx   -   2 w' x v + w' x (w' x d)
// so that the arc leaves its chord by (|o|^2 + |o x w'|) / 8 |x| and (2 |w' x v| + |w'| |w' x d|) /
// 8 at most.
static void nsvcd__cut_double_arc(const nsvcd__motion *motion, const nsvcd__v_poses *from,
                                  const nsvcd__v_poses *to, size_t l, nsvcd__cut *cut) {
  const nsvcd__v eighth = nsvcd__v_set(0.12501f);
  nsvcd__v cosine;
  nsvcd__v fixed_cosine;
  const nsvcd__v3 half = nsvcd__v_shorter_turn_between(from->moving, to->moving, &cosine);
  const nsvcd__v3 fixed_half =
      nsvcd__v_shorter_turn_between(from->fixed, to->fixed, &fixed_cosine);
  const nsvcd__v sine = nsvcd__v3_length(half);
  const nsvcd__v fixed_sine = nsvcd__v3_length(fixed_half);
  const nsvcd__v sines = nsvcd__v_add(sine, fixed_sine);
  const nsvcd__v least_cosine = nsvcd__v_min(cosine, fixed_cosine);
  const nsvcd__v apart = nsvcd__v3_length(nsvcd__v3_sub(half, fixed_half));
  const nsvcd__v difference = nsvcd__v_pick(least_cosine, nsvcd__v_set(0.001f), sines, apart);
  // A rotation vector is 2 asin(s) / s times these halves of length s, and asin(s) - s is at most
  // (pi / 2 - 1) s^3.
  const nsvcd__v square = nsvcd__v_mul(sine, sine);
  const nsvcd__v fixed_square = nsvcd__v_mul(fixed_sine, fixed_sine);
  const nsvcd__v cubes = nsvcd__v_fma(square, sine, nsvcd__v_mul(fixed_square, fixed_sine));
  nsvcd__v turn = nsvcd__v_scale(difference, 2.00001f);
  turn = nsvcd__v_fma(nsvcd__v_set(1.1417f), cubes, turn);
  turn = nsvcd__v_fma(nsvcd__v_set(2e-6f), sines, turn);
  const nsvcd__v fixed_turn = nsvcd__v_arc(from->fixed, to->fixed);
  const nsvcd__v squares = nsvcd__v_mul(turn, nsvcd__v_add(turn, fixed_turn));
  nsvcd__v_keep_most(cut->most.arc_bend + l, nsvcd__v_mul(squares, eighth));

  const nsvcd__v remote_start = nsvcd__v3_length(from->offset);
  const nsvcd__v extent = nsvcd__v_max(remote_start, nsvcd__v3_length(to->offset));
  const nsvcd__v travel = nsvcd__v3_length(nsvcd__v3_sub(to->offset, from->offset));
  const nsvcd__v both = nsvcd__v_fma(fixed_turn, extent, nsvcd__v_add(travel, travel));
  const nsvcd__v metres = nsvcd__v_mul(nsvcd__v_mul(fixed_turn, both), eighth);
  const nsvcd__v origin_bend = nsvcd__v_div(metres, nsvcd__v_set(motion->unit));
  nsvcd__v_keep_most(cut->most.arc_origin + l, origin_bend);
  nsvcd__v_add_to(cut->most.sum + l, fixed_turn);
}

// Adds the arc from the last keyframe to this one, which becomes the last. seen: its rotation as
// the fixed body sees it.
static void nsvcd__cut_arc(const nsvcd__motion *motion, const nsvcd__v_poses *at,
                           nsvcd__vquat seen, size_t l, nsvcd__segments *out,
                           nsvcd__cut *cut) {
  const nsvcd__v_poses last = nsvcd__keyframes_load(motion, &cut->last, l);
  const nsvcd__v arc = nsvcd__v_arc(last.moving, at->moving);
  nsvcd__v_add_to(cut->most.sum + l, arc);
  if (motion->fixed_moves) {
    nsvcd__cut_double_arc(motion, &last, at, l, cut);
  } else {
    const nsvcd__v3 axis = nsvcd__v3_load(out->axis, l);
    const nsvcd__vquat last_seen = nsvcd__vquat_load(cut->last.seen + l, NSVCD__KEYFRAMES);
    const nsvcd__v bend = nsvcd__v_scale(nsvcd__v_mul(arc, arc), 0.125f);
    const nsvcd__v off_axis = nsvcd__v_turn_off_axis(axis, last_seen, seen, arc);
    nsvcd__v_keep_most(cut->most.arc_bend + l, bend);
    nsvcd__v_keep_most(cut->most.arc_bend_along_axis + l, off_axis);
  }
  nsvcd__keyframes_keep(motion, at, seen, l, &cut->last);
}

// Visits a keyframe of each segment: ticks (16), of segments that begin at begin[0..15] and end at
// begin[1..16]. Adds the arc up to it, and what it is off its segment's chord by.
static NSVCD__NOINLINE void nsvcd__cut_keyframe(const nsvcd__motion *motion,
                                                const uint32_t *begin, const uint32_t *ticks,
                                                nsvcd__segments *out, nsvcd__cut *cut) {
  nsvcd__bends *most = &cut->most;
  // of the segment, before the keyframe
  float fraction[NSVCD__LANES];
  nsvcd__keyframes_read(motion, ticks, NSVCD__LANES, &cut->here);
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const uint32_t length = begin[l + 1] - begin[l];
    fraction[l] = length ? (float)(ticks[l] - begin[l]) / (float)length : 0;
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(motion, &cut->here, l);
    const nsvcd__v_pose seen = nsvcd__v_seen(motion, &at);
    nsvcd__cut_arc(motion, &at, seen.rotation, l, out, cut);
    const nsvcd__v u = nsvcd__v_load(fraction + l);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__vmat3 turned = nsvcd__vmat3_load(out->turned, l);
    const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
    const nsvcd__vmat3 scaled = nsvcd__vmat3_scale(rotation, nsvcd__v_set(motion->scale));
    const nsvcd__vmat3 off = nsvcd__vmat3_sub(scaled, nsvcd__vmat3_fma(u, turned, start));
    const nsvcd__v3 position = nsvcd__v3_load(out->position, l);
    const nsvcd__v3 chord = nsvcd__v3_fma(u, nsvcd__v3_load(out->moved, l), position);
    const nsvcd__v3 aside = nsvcd__v3_sub(seen.position, chord);
    nsvcd__v_keep_most(most->bend + l, nsvcd__vmat3_square(off));
    nsvcd__v_keep_most(most->margin + l, nsvcd__v3_dot(aside, aside));

    const nsvcd__v3 axis = nsvcd__v3_load(out->axis, l);
    const nsvcd__v3 along = nsvcd__vmat3_apply_transpose(off, axis);
    const nsvcd__v3 off_way = nsvcd__v3_cross(nsvcd__v3_load(out->heading, l), aside);
    const nsvcd__v off_axis = nsvcd__v3_dot(axis, aside);
    nsvcd__v_keep_most(most->keyframe_bend_along_axis + l, nsvcd__v3_dot(along, along));
    nsvcd__v_keep_most(most->keyframe_origin_along_axis + l, nsvcd__v_mul(off_axis, off_axis));
    nsvcd__v_keep_most(most->keyframe_origin_off_heading + l, nsvcd__v3_dot(off_way, off_way));
  }
}

// The deviations of segments whose keyframes have all been visited.
static void nsvcd__cut_deviations(const nsvcd__motion *motion, float lengths, size_t l,
                                  nsvcd__segments *out, const nsvcd__cut *cut) {
  const nsvcd__bends *most = &cut->most;
  const nsvcd__v scale = nsvcd__v_set(motion->scale);
  const nsvcd__v off_chord = nsvcd__v_sqrt(nsvcd__v_load(most->margin + l));
  const nsvcd__v origin_bend = nsvcd__v_add(off_chord, nsvcd__v_load(most->arc_origin + l));
  const nsvcd__v arc_bend = nsvcd__v_mul(scale, nsvcd__v_load(most->arc_bend + l));
  const nsvcd__v keyframe_bulge = nsvcd__v_sqrt(nsvcd__v_load(most->bend + l));
  const nsvcd__v bend = nsvcd__v_add(arc_bend, keyframe_bulge);
  nsvcd__v bend_along_axis = bend;
  nsvcd__v origin_along_axis = origin_bend;
  nsvcd__v origin_off_heading = origin_bend;
  if (!motion->fixed_moves) {
    const nsvcd__v arc_bend_along_axis =
        nsvcd__v_mul(scale, nsvcd__v_load(most->arc_bend_along_axis + l));
    const nsvcd__v keyframe_bend_along_axis =
        nsvcd__v_sqrt(nsvcd__v_load(most->keyframe_bend_along_axis + l));
    bend_along_axis = nsvcd__v_add(keyframe_bend_along_axis, arc_bend_along_axis);
    origin_along_axis = nsvcd__v_sqrt(nsvcd__v_load(most->keyframe_origin_along_axis + l));
    origin_off_heading = nsvcd__v_sqrt(nsvcd__v_load(most->keyframe_origin_off_heading + l));
  }
  nsvcd__v_store(out->bend + l, bend);
  nsvcd__v_store(out->origin_bend + l, origin_bend);
  nsvcd__v_store(out->bend_along_axis + l, bend_along_axis);
  nsvcd__v_store(out->origin_along_axis + l, origin_along_axis);
  nsvcd__v_store(out->origin_off_heading + l, origin_off_heading);

  const nsvcd__v3 start = nsvcd__v3_load(out->position, l);
  const nsvcd__v3 end = nsvcd__v3_add(start, nsvcd__v3_load(out->moved, l));
  const nsvcd__v extent = nsvcd__v_add(nsvcd__v3_length(start), nsvcd__v3_length(end));
  const nsvcd__v all = nsvcd__v_add(extent, nsvcd__v_plus(origin_bend, lengths));
  const nsvcd__v rounding = nsvcd__v_scale(all, NSVCD__ROUNDING);
  nsvcd__v_store(out->rounding + l, rounding);
  nsvcd__v_store(out->margin + l, nsvcd__v_add(rounding, origin_bend));
}

// Cuts 16 segments, of which `count` exist. begin: (17) ticks at which they begin, and the last one
// ends. turn: (16) the angle by which each turns.
static void nsvcd__cut_block(const nsvcd__motion *motion, const uint32_t *begin, size_t count,
                             float lengths, nsvcd__segments *out, nsvcd__cut *cut,
                             float *turn) {
  uint32_t ticks[NSVCD__LANES];
  nsvcd__cut_starts(motion, begin, out, cut);
  nsvcd__cut_ends(motion, out, cut);
  memcpy(ticks, begin, sizeof ticks);
  for (int within = 1; within;) {
    within = 0;
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      const uint32_t next =
          ticks[l] < begin[l + 1] ? nsvcd__next_keyframe(motion, ticks[l]) : begin[l + 1];
      ticks[l] = next < begin[l + 1] ? next : begin[l + 1];
      within |= ticks[l] < begin[l + 1];
    }
    if (within) nsvcd__cut_keyframe(motion, begin, ticks, out, cut);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses end = nsvcd__keyframes_load(motion, &cut->end, l);
    const nsvcd__vquat seen = nsvcd__vquat_load(cut->end.seen + l, NSVCD__KEYFRAMES);
    nsvcd__cut_arc(motion, &end, seen, l, out, cut);
    nsvcd__cut_deviations(motion, lengths, l, out, cut);
  }
  memcpy(turn, cut->most.sum, sizeof cut->most.sum);
  // these meet nothing
  for (size_t l = count; l < NSVCD__LANES; l++) out->margin[l] = NSVCD__NOWHERE;
}

// Fills the blocks: the chosen segments' poses in the fixed body's frame, and deviations. lengths:
// the bodies' extents; clearance: spheres that come so near are to count as meeting.
static void nsvcd__cut_segments(const nsvcd__motion *motion, float lengths, float clearance,
                                nsvcd__search *search) {
  search->turn[0] = 0;
  for (size_t first = 0; first < search->segments; first += NSVCD__LANES) {
    const size_t left = search->segments - first;
    const size_t count = left < NSVCD__LANES ? left : NSVCD__LANES;
    uint32_t ends[NSVCD__LANES + 1];
    float turn[NSVCD__LANES];
    for (size_t l = 0; l <= NSVCD__LANES; l++)
      ends[l] = search->begin[first + (l < count ? l : count)];
    nsvcd__segments *block = &search->blocks[first / NSVCD__LANES];
    nsvcd__cut_block(motion, ends, count, lengths, block, search->cut, turn);
    for (size_t l = 0; l < count; l++) block->margin[l] += clearance;
    for (size_t l = 0; l < count; l++)
      search->turn[first + l + 1] = search->turn[first + l] + turn[l];
  }
}

// Stores a slice of chords, from lane l on. FLT_MIN keeps a chord of no length finite.
static void nsvcd__chords_store(nsvcd__chords *c, size_t l, nsvcd__v3 start, nsvcd__v3 travel,
                                nsvcd__v radius) {
  const nsvcd__v square = nsvcd__v_max(nsvcd__v3_dot(travel, travel), nsvcd__v_set(1.2e-38f));
  nsvcd__v3_store(c->start, l, start);
  nsvcd__v3_store(c->travel, l, travel);
  nsvcd__v_store(c->inverse + l, nsvcd__v_div(nsvcd__v_set(-1), square));
  nsvcd__v_store(c->radius + l, radius);
}

// Chords of one sphere, body frame, in the segments of a block.
static void nsvcd__chords_of_sphere(nsvcd__segments *b, nsvcd__sphere sphere,
                                    nsvcd__chords *out) {
  const nsvcd__v3 centre = nsvcd__v3_set(sphere.centre);
  const nsvcd__v length = nsvcd__v_set(nsvcd__f3_length(sphere.centre));
  const nsvcd__v radius = nsvcd__v_set(sphere.radius);
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

// Chords of 16 spheres in one segment: lane s of a block. The patches that they contain are no
// farther than `extent` from the body's origin, in its own frame and units; scale: of the body. The
// centre of a sphere over patches may be farther: on their chords points of a body do not move
// apart, so that it is enough to allow for what the patches deviate.
static void nsvcd__chords_of_members(nsvcd__segments *b, size_t s, nsvcd__spheres members,
                                     float scale, float extent, nsvcd__chords *out) {
  const nsvcd__v deviation = nsvcd__v_set(b->margin[s] + b->bend[s] * extent);
  const nsvcd__mat3 rotation = nsvcd__mat3_lane(b->rotation, s);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(b->turned, s);
  const nsvcd__v3 position = nsvcd__v3_set(nsvcd__lane_of(b->position, s));
  const nsvcd__v3 moved = nsvcd__v3_set(nsvcd__lane_of(b->moved, s));
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(members, l);
    const nsvcd__vmat3 rotations = nsvcd__vmat3_set(&rotation);
    const nsvcd__vmat3 turns = nsvcd__vmat3_set(&turned);
    const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotations, centre, position);
    const nsvcd__v3 travel = nsvcd__vmat3_apply_add(turns, centre, moved);
    const nsvcd__v radius = nsvcd__v_load(members.r + l);
    const nsvcd__v grown = nsvcd__v_fma(nsvcd__v_set(scale), radius, deviation);
    nsvcd__chords_store(out, l, start, travel, grown);
  }
}

// Squared distance of the chord from the resting centre. d: from that centre to the start of the
// chord.
NSVCD__INLINE nsvcd__v nsvcd__nearest2(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse) {
  const nsvcd__v tau = nsvcd__v_clamp(nsvcd__v_mul(nsvcd__v3_dot(d, travel), inverse), 0, 1);
  const nsvcd__v3 nearest = nsvcd__v3_fma(tau, travel, d);
  return nsvcd__v3_dot(nearest, nearest);
}

// The test. A bit for each lane of the slice: does the chord come within `radius` of the resting
// centre? d: from that to the start of the chord.
NSVCD__INLINE uint32_t nsvcd__comes_within(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse,
                                           nsvcd__v radius) {
  return nsvcd__v_le(nsvcd__nearest2(d, travel, inverse), nsvcd__v_signed_square(radius));
}

NSVCD__INLINE nsvcd__v3 nsvcd__chords_start(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->start[0] + l);
}
NSVCD__INLINE nsvcd__v3 nsvcd__chords_travel(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->travel[0] + l);
}

// 16 moving spheres, or one in 16 segments, against one resting sphere.
static uint32_t nsvcd__meet(const nsvcd__chords *c, nsvcd__sphere resting) {
  const nsvcd__v3 centre = nsvcd__v3_set(resting.centre);
  const nsvcd__v radius = nsvcd__v_set(resting.radius);
  uint32_t met = 0;
  NSVCD__TALLY(tests, 1);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v sum = nsvcd__v_add(nsvcd__v_load(c->radius + l), radius);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    met |= nsvcd__comes_within(d, nsvcd__chords_travel(c, l), inverse, sum) << l;
  }
  return met;
}

// Lane s of chords against 16 resting spheres.
NSVCD__INLINE uint32_t nsvcd__meet_members(const nsvcd__chords *c, size_t s,
                                           nsvcd__spheres resting) {
  const nsvcd__v3 start = nsvcd__v3_set(nsvcd__f3_get(c->start[0] + s, NSVCD__LANES));
  const nsvcd__v3 travel = nsvcd__v3_set(nsvcd__f3_get(c->travel[0] + s, NSVCD__LANES));
  const nsvcd__v inverse = nsvcd__v_set(c->inverse[s]);
  const nsvcd__v own = nsvcd__v_set(c->radius[s]);
  uint32_t met = 0;
  NSVCD__TALLY(tests, 1);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_centres(resting, l));
    const nsvcd__v radius = nsvcd__v_add(own, nsvcd__v_load(resting.r + l));
    met |= nsvcd__comes_within(d, travel, inverse, radius) << l;
  }
  return met;
}

// The segments among `wanted` in which a sphere with chords[] (one block per 16 segments) meets a
// resting one.
static uint64_t nsvcd__meet_in(const nsvcd__chords *chords, uint64_t wanted,
                               nsvcd__sphere resting) {
  uint64_t met = 0;
  for (size_t block = 0; block < NSVCD__BLOCKS && wanted >> (NSVCD__LANES * block); block++) {
    const size_t shift = NSVCD__LANES * block;
    if (wanted >> shift & 0xffff)
      met |= (uint64_t)nsvcd__meet(&chords[block], resting) << shift;
  }
  return met & wanted;
}
