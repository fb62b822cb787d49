// In: a motion, and the ticks at which its segments begin. Out: for 16 segments at a time the
// moving body's pose at the start, its change until the end, and how far points deviate from that.
//
// Within a segment a point c of the moving body, in its frame, is taken along the chord between its
// positions at both ends, x0 + tau v, tau in [0,1]. Its true position M(t) c + p(t), where M is the
// rotation times the scale, is no farther from the chord's than
//   origin_bend + bend |c|
// Proof: let L(t) interpolate M linearly between the segment's ends, K(t) piecewise between the
// keyframes inside. Between two keyframes a chord misses a curve by at most max|second derivative|
// / 8, with time from 0 to 1 there. If one body moves, that is h^2 |c| / 8 on an arc of angle h,
// and its origin moves straight; if both do, see nsvcd__cut_double_arc. K - L is piecewise linear
// and its norm convex, so it is largest at a keyframe. Hence
//   bend        = max over arcs of their bend per metre
//                 + max over keyframes ||M_k - L(t_k)||  (Frobenius >= 2-norm)
//   origin_bend = max over arcs of the origin's bend
//                 + max over keyframes |p_k - its linear interpolation|
//   margin      = origin_bend + rounding + the clearance asked for
//
// A body that turns about a pivot is one whose origin is there, with points shifted by -pivot: so
// its origin is no farther from its chord than its arcs bend times |pivot| more.
//
// Along a direction n, |n| <= 1, the deviation is smaller. A turn by h about the unit axis a bends
// the path of a point x by a x (a x y) h^2, y being x, turned; and n.(a x (a x y)) = (n x a).(a x
// y), at most |n x a| |x|: nothing along the axis. `bend_along_axis` and `origin_along_axis` are
// what is left along the axis of the whole segment's turn, from which the axes of its arcs may
// differ. nsvcd__deviation_of puts them together.
#pragma once
#include "../lanes/turns.h"
#include "../motion/choice.h"

// A slice of poses of both bodies in the world.
typedef struct nsvcd__v_poses {
  nsvcd__vquat moving;  // of any length
  nsvcd__vquat fixed;   // unit; only where that body moves
  nsvcd__v3 offset;     // from the fixed body's pivot to the moving one's, metres
} nsvcd__v_poses;

// A slice of poses.
typedef struct nsvcd__v_pose {
  nsvcd__vquat rotation;
  nsvcd__v3 position;
} nsvcd__v_pose;

// The moving body's poses in the fixed body's frame: quaternions of any length, positions in its
// units.
static nsvcd__v_pose nsvcd__v_seen(const nsvcd__motion *m, const nsvcd__v_poses *at) {
  const nsvcd__v per_metre = nsvcd__v_set(1 / m->unit);
  nsvcd__vquat to_fixed;
  nsvcd__vmat3 matrix;
  if (m->fixed_moves) {
    to_fixed = nsvcd__vquat_inverse(at->fixed);
    matrix = nsvcd__vmat3_of(to_fixed);
  } else {
    to_fixed = nsvcd__vquat_set(m->to_fixed_quat);
    matrix = nsvcd__vmat3_set(&m->to_fixed);
  }
  const nsvcd__v3 metres = nsvcd__vmat3_apply(matrix, at->offset);
  nsvcd__v_pose out;
  out.rotation = nsvcd__vquat_mul(to_fixed, at->moving);
  out.position = nsvcd__v3_fma(per_metre, metres, nsvcd__v3_set(m->push_out));
  if (m->fixed.pivot) {
    const nsvcd__v3 pivot = nsvcd__v3_set(nsvcd__f3_load(m->fixed.pivot));
    out.position = nsvcd__v3_add(out.position, pivot);
  }
  if (m->moving.pivot) {
    const nsvcd__v3 pivot = nsvcd__v3_set(nsvcd__f3_load(m->moving.pivot));
    const nsvcd__v3 arm = nsvcd__vmat3_apply(nsvcd__vmat3_of(out.rotation), pivot);
    out.position = nsvcd__v3_fma(nsvcd__v_set(-m->scale), arm, out.position);
  }
  return out;
}

// ---- turns between quaternions

// 1 where x >= 0, else -1.
static nsvcd__v nsvcd__v_sign(nsvcd__v x) {
  return nsvcd__v_pick(nsvcd__v_set(0), x, nsvcd__v_set(1), nsvcd__v_set(-1));
}

// An upper bound of the angle between two rotations, unit to 1e-4, tight where it is small: 4
// asin(chord / 2) of their chord as quaternions, with asin x <= x + (pi/2 - 1) x^3, and half a
// thousandth for the lengths.
static nsvcd__v nsvcd__v_arc(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__vquat_dot(a, b));
  const nsvcd__vquat chord = nsvcd__vquat_fma(nsvcd__v_negate(sign), b, a);
  const nsvcd__v length = nsvcd__v_sqrt(nsvcd__vquat_dot(chord, chord));
  const nsvcd__v x = nsvcd__v_scale(length, 0.50025f);
  const nsvcd__v square = nsvcd__v_mul(x, x);
  return nsvcd__v_mul(x, nsvcd__v_fma(nsvcd__v_set(2.2832f), square, nsvcd__v_set(4)));
}

// The vector part of b a^-1: the axis of the turn from a to b, times the sine of half its angle.
static nsvcd__v3 nsvcd__v_turn(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v3 u = nsvcd__vquat_axis(a);
  const nsvcd__v3 v = nsvcd__vquat_axis(b);
  const nsvcd__v3 sum = nsvcd__v3_fma(nsvcd__v_negate(b.w), u, nsvcd__v3_cross(u, v));
  return nsvcd__v3_fma(a.w, v, sum);
}

// The same on the shorter arc. cosine: of half the angle; near 0, rounding may have taken the
// longer one.
static nsvcd__v3 nsvcd__v_shorter_turn(nsvcd__vquat a, nsvcd__vquat b, nsvcd__v *cosine) {
  const nsvcd__v dot = nsvcd__vquat_dot(a, b);
  const nsvcd__v sign = nsvcd__v_sign(dot);
  *cosine = nsvcd__v_mul(sign, dot);
  return nsvcd__v3_scale(nsvcd__v_turn(a, b), sign);
}

// ---- keyframes

// Reads the poses of both bodies at `count` ticks.
static void nsvcd__keyframes_read(const nsvcd__motion *m, const uint32_t *ticks, size_t count,
                                  nsvcd__keyframes *out) {
  nsvcd__world_pose fixed = {{0, 0, 0, 1}, nsvcd__d3_widen(m->fixed_position)};
  nsvcd__world_pose moving = fixed;
  nsvcd__f3 offset = {0, 0, 0};
  for (size_t l = 0; l < count; l++) {
    // segments of no length have the pose before
    if (l == 0 || ticks[l] != ticks[l - 1]) {
      moving = nsvcd__track_pose(&m->moving, ticks[l]);
      if (m->fixed_moves) fixed = nsvcd__track_pose(&m->fixed, ticks[l]);
      offset = nsvcd__d3_narrow(nsvcd__d3_sub(moving.position, fixed.position));
    }
    nsvcd__quat_put(moving.rotation, out->moving + l, NSVCD__ENDS);
    nsvcd__f3_put(offset, out->offset + l, NSVCD__ENDS);
    if (m->fixed_moves) nsvcd__quat_put(fixed.rotation, out->fixed + l, NSVCD__ENDS);
  }
}

// A slice of them from lane l on; l may be 1, for there is one keyframe more than lanes.
static nsvcd__v_poses nsvcd__keyframes_load(const nsvcd__motion *m,
                                            const nsvcd__keyframes *from, size_t l) {
  nsvcd__v_poses out;
  out.offset = nsvcd__v3_get(from->offset + l, NSVCD__ENDS);
  out.moving = nsvcd__vquat_load(from->moving + l, NSVCD__ENDS);
  out.fixed = out.moving;
  if (m->fixed_moves) {
    out.moving = nsvcd__vquat_unit(out.moving);
    out.fixed = nsvcd__vquat_unit(nsvcd__vquat_load(from->fixed + l, NSVCD__ENDS));
  }
  return out;
}

// Stores a slice with its rotations in the fixed body's frame.
static void nsvcd__keyframes_store(const nsvcd__motion *m, const nsvcd__v_poses *at,
                                   nsvcd__vquat seen, size_t l, nsvcd__keyframes *out) {
  nsvcd__vquat_store(at->moving, out->moving + l, NSVCD__ENDS);
  nsvcd__vquat_store(seen, out->seen + l, NSVCD__ENDS);
  if (!m->fixed_moves) return;
  nsvcd__v3_put(at->offset, out->offset + l, NSVCD__ENDS);
  nsvcd__vquat_store(at->fixed, out->fixed + l, NSVCD__ENDS);
}

// Rotations times the scale.
NSVCD__INLINE nsvcd__vmat3 nsvcd__v_scaled(const nsvcd__motion *m, nsvcd__vquat q) {
  return nsvcd__vmat3_scale(nsvcd__vmat3_of(q), nsvcd__v_set(m->scale));
}

// ---- the deviation of arcs and of keyframes

static void nsvcd__v_keep(float *most, nsvcd__v value) {
  nsvcd__v_store(most, nsvcd__v_max(nsvcd__v_load(most), value));
}
static void nsvcd__v_add_to(float *sum, nsvcd__v value) {
  nsvcd__v_store(sum, nsvcd__v_add(nsvcd__v_load(sum), value));
}

// An arc in which both bodies move. With w and w' the rotation vectors of the moving and the fixed
// body over the arc, in the world, o = w - w', and d the vector from the fixed origin to the moving
// one, which moves by v, the second derivative of a point x in the fixed body's frame is
//   o x (o x Rx) + (o x w') x Rx   -   2 w' x v + w' x (w' x d)
// so that the arc leaves its chord by (|o|^2 + |o x w'|) / 8 |x| and (2 |w' x v| + |w'| |w' x d|) /
// 8 at most.
static void nsvcd__cut_double_arc(const nsvcd__motion *m, const nsvcd__v_poses *from,
                                  const nsvcd__v_poses *to, size_t l, nsvcd__bends *most) {
  const nsvcd__v eighth = nsvcd__v_set(0.12501f);
  nsvcd__v cosine;
  nsvcd__v fixed_cosine;
  const nsvcd__v3 half = nsvcd__v_shorter_turn(from->moving, to->moving, &cosine);
  const nsvcd__v3 fixed_half = nsvcd__v_shorter_turn(from->fixed, to->fixed, &fixed_cosine);
  const nsvcd__v sine = nsvcd__v3_norm(half);
  const nsvcd__v fixed_sine = nsvcd__v3_norm(fixed_half);
  const nsvcd__v sines = nsvcd__v_add(sine, fixed_sine);
  const nsvcd__v least_cosine = nsvcd__v_min(cosine, fixed_cosine);
  const nsvcd__v apart = nsvcd__v3_norm(nsvcd__v3_sub(half, fixed_half));
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
  nsvcd__v_keep(most->arc_bend + l, nsvcd__v_mul(squares, eighth));

  const nsvcd__v start = nsvcd__v3_norm(from->offset);
  const nsvcd__v extent = nsvcd__v_max(start, nsvcd__v3_norm(to->offset));
  const nsvcd__v travel = nsvcd__v3_norm(nsvcd__v3_sub(to->offset, from->offset));
  const nsvcd__v both = nsvcd__v_fma(fixed_turn, extent, nsvcd__v_add(travel, travel));
  const nsvcd__v metres = nsvcd__v_mul(nsvcd__v_mul(fixed_turn, both), eighth);
  const nsvcd__v origin_bend = nsvcd__v_div(metres, nsvcd__v_set(m->unit));
  nsvcd__v_keep(most->arc_origin + l, origin_bend);
  nsvcd__v_add_to(most->turn + l, fixed_turn);
}

// Adds the arc from the last keyframes to these, which become the last. seen: their rotations in
// the fixed body's frame.
static void nsvcd__cut_arc(const nsvcd__motion *m, const nsvcd__v_poses *at, nsvcd__vquat seen,
                           size_t l, nsvcd__segments *out, nsvcd__cut *cut) {
  nsvcd__bends *most = &cut->most;
  const nsvcd__v_poses last = nsvcd__keyframes_load(m, &cut->last, l);
  const nsvcd__v arc = nsvcd__v_arc(last.moving, at->moving);
  nsvcd__v_add_to(most->turn + l, arc);
  if (m->fixed_moves) {
    nsvcd__cut_double_arc(m, &last, at, l, most);
  } else {
    // Along the axis: h^2 / 8 |axis x a| of a turn by h about a. With w = a sin(h / 2) that is at
    // most pi / 8 h |axis x w|.
    const nsvcd__vquat last_seen = nsvcd__vquat_load(cut->last.seen + l, NSVCD__ENDS);
    const nsvcd__v3 w = nsvcd__v_turn(last_seen, seen);
    const nsvcd__v3 across = nsvcd__v3_cross(nsvcd__v3_load(out->axis, l), w);
    const nsvcd__v most_along = nsvcd__v_scale(arc, 0.3931f);
    const nsvcd__v along = nsvcd__v_mul(most_along, nsvcd__v3_norm(across));
    nsvcd__v_keep(most->arc_bend + l, nsvcd__v_scale(nsvcd__v_mul(arc, arc), 0.125f));
    nsvcd__v_keep(most->arc_along_axis + l, along);
  }
  nsvcd__keyframes_store(m, at, seen, l, &cut->last);
}

// Visits a keyframe of each segment: ticks (16), begin (17) as nsvcd__cut_block has it. Adds the
// arc before it, and how far it is off its segment's chord.
static NSVCD__NOINLINE void nsvcd__cut_keyframe(const nsvcd__motion *m, const uint32_t *begin,
                                                const uint32_t *ticks, nsvcd__segments *out,
                                                nsvcd__cut *cut) {
  nsvcd__bends *most = &cut->most;
  nsvcd__row fraction;  // of the segment, before the keyframe
  nsvcd__keyframes_read(m, ticks, NSVCD__LANES, &cut->here);
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const uint32_t length = begin[l + 1] - begin[l];
    fraction[l] = length ? (float)(ticks[l] - begin[l]) / (float)length : 0;
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(m, &cut->here, l);
    const nsvcd__v_pose seen = nsvcd__v_seen(m, &at);
    nsvcd__cut_arc(m, &at, seen.rotation, l, out, cut);
    const nsvcd__v u = nsvcd__v_load(fraction + l);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__vmat3 turned = nsvcd__vmat3_load(out->turned, l);
    const nsvcd__vmat3 scaled = nsvcd__v_scaled(m, seen.rotation);
    const nsvcd__vmat3 off = nsvcd__vmat3_sub(scaled, nsvcd__vmat3_fma(u, turned, start));
    const nsvcd__v3 position = nsvcd__v3_load(out->position, l);
    const nsvcd__v3 chord = nsvcd__v3_fma(u, nsvcd__v3_load(out->moved, l), position);
    const nsvcd__v3 aside = nsvcd__v3_sub(seen.position, chord);
    nsvcd__v_keep(most->off + l, nsvcd__vmat3_square(off));
    nsvcd__v_keep(most->origin_off + l, nsvcd__v3_dot(aside, aside));

    const nsvcd__v3 axis = nsvcd__v3_load(out->axis, l);
    const nsvcd__v3 along = nsvcd__vmat3_apply_transpose(off, axis);
    const nsvcd__v3 across = nsvcd__v3_cross(nsvcd__v3_load(out->heading, l), aside);
    const nsvcd__v height = nsvcd__v3_dot(axis, aside);
    nsvcd__v_keep(most->along_axis + l, nsvcd__v3_dot(along, along));
    nsvcd__v_keep(most->origin_along_axis + l, nsvcd__v_mul(height, height));
    nsvcd__v_keep(most->origin_off_heading + l, nsvcd__v3_dot(across, across));
  }
}

// ---- segments

// Poses at the starts of 16 segments; at their ends, if `to` is 1.
static NSVCD__NOINLINE void nsvcd__cut_poses(const nsvcd__motion *m,
                                             const nsvcd__keyframes *here, size_t to,
                                             nsvcd__row *rotation, nsvcd__row *position,
                                             nsvcd__keyframes *out) {
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(m, here, l + to);
    const nsvcd__v_pose seen = nsvcd__v_seen(m, &at);
    nsvcd__keyframes_store(m, &at, seen.rotation, l, out);
    nsvcd__vmat3_store(rotation, l, nsvcd__v_scaled(m, seen.rotation));
    nsvcd__v3_store(position, l, seen.position);
  }
}

// Sets the poses at the segments' starts, and their change until the ends: begin (17).
static NSVCD__NOINLINE void nsvcd__cut_ends(const nsvcd__motion *m, const uint32_t *begin,
                                            nsvcd__segments *out, nsvcd__cut *cut) {
  nsvcd__keyframes_read(m, begin, NSVCD__ENDS, &cut->here);
  nsvcd__cut_poses(m, &cut->here, 0, out->rotation, out->position, &cut->last);
  nsvcd__cut_poses(m, &cut->here, 1, out->turned, out->moved, &cut->end);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__vquat from = nsvcd__vquat_load(cut->last.seen + l, NSVCD__ENDS);
    const nsvcd__vquat to = nsvcd__vquat_load(cut->end.seen + l, NSVCD__ENDS);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__vmat3 end = nsvcd__vmat3_load(out->turned, l);
    const nsvcd__v3 position = nsvcd__v3_load(out->position, l);
    const nsvcd__v3 moved = nsvcd__v3_sub(nsvcd__v3_load(out->moved, l), position);
    nsvcd__vmat3_store(out->turned, l, nsvcd__vmat3_sub(end, start));
    nsvcd__v3_store(out->moved, l, moved);
    nsvcd__v3_store(out->axis, l, nsvcd__v3_unit(nsvcd__v_turn(from, to)));
    nsvcd__v3_store(out->heading, l, nsvcd__v3_unit(moved));
  }
}

// What arcs are off, times the arm, plus what keyframes are, whose square is given.
static nsvcd__v nsvcd__v_bend(nsvcd__v arm, const float *arcs, const float *keyframes) {
  const nsvcd__v off = nsvcd__v_sqrt(nsvcd__v_load(keyframes));
  return nsvcd__v_add(off, nsvcd__v_mul(arm, nsvcd__v_load(arcs)));
}

// Sets the deviations, once all keyframes have been visited. If both bodies move, they are not
// smaller along any direction.
static void nsvcd__cut_deviations(const nsvcd__motion *m, float lengths, size_t l,
                                  nsvcd__segments *out, const nsvcd__bends *most) {
  const int both = m->fixed_moves;
  const nsvcd__v scale = nsvcd__v_set(m->scale);
  const nsvcd__v pivot = nsvcd__v_set(nsvcd__pivot_arm(m, &m->moving));
  const nsvcd__v bend = nsvcd__v_bend(scale, most->arc_bend + l, most->off + l);
  const nsvcd__v off = nsvcd__v_bend(pivot, most->arc_bend + l, most->origin_off + l);
  const nsvcd__v origin_bend = nsvcd__v_add(off, nsvcd__v_load(most->arc_origin + l));
  const nsvcd__v along = nsvcd__v_bend(scale, most->arc_along_axis + l, most->along_axis + l);
  const nsvcd__v origin_along =
      nsvcd__v_bend(pivot, most->arc_along_axis + l, most->origin_along_axis + l);
  const nsvcd__v across =
      nsvcd__v_bend(pivot, most->arc_bend + l, most->origin_off_heading + l);
  nsvcd__v_store(out->bend + l, bend);
  nsvcd__v_store(out->origin_bend + l, origin_bend);
  nsvcd__v_store(out->bend_along_axis + l, both ? bend : along);
  nsvcd__v_store(out->origin_along_axis + l, both ? origin_bend : origin_along);
  nsvcd__v_store(out->origin_off_heading + l, both ? origin_bend : across);

  const nsvcd__v3 start = nsvcd__v3_load(out->position, l);
  const nsvcd__v3 end = nsvcd__v3_add(start, nsvcd__v3_load(out->moved, l));
  const nsvcd__v extent = nsvcd__v_add(nsvcd__v3_norm(start), nsvcd__v3_norm(end));
  const nsvcd__v all = nsvcd__v_add(extent, nsvcd__v_plus(origin_bend, lengths));
  const nsvcd__v rounding = nsvcd__v_scale(all, NSVCD__ROUNDING);
  nsvcd__v_store(out->rounding + l, rounding);
  nsvcd__v_store(out->margin + l, nsvcd__v_add(rounding, origin_bend));
}

// Cuts 16 segments, of which the first `count` exist. begin: (17) ticks at which they begin, and
// the last one ends. lengths: the bodies' extents. Leaves the angle by which each turns in
// cut->most.turn.
static void nsvcd__cut_block(const nsvcd__motion *m, const uint32_t *begin, size_t count,
                             float lengths, nsvcd__segments *out, nsvcd__cut *cut) {
  uint32_t ticks[NSVCD__LANES];
  memset(&cut->most, 0, sizeof cut->most);
  memcpy(ticks, begin, sizeof ticks);
  nsvcd__cut_ends(m, begin, out, cut);
  for (int is_inside = 1; is_inside;) {
    is_inside = 0;
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      if (ticks[l] < begin[l + 1]) ticks[l] = nsvcd__next_keyframe(m, ticks[l]);
      if (ticks[l] > begin[l + 1]) ticks[l] = begin[l + 1];
      is_inside |= ticks[l] < begin[l + 1];
    }
    if (is_inside) nsvcd__cut_keyframe(m, begin, ticks, out, cut);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses end = nsvcd__keyframes_load(m, &cut->end, l);
    const nsvcd__vquat seen = nsvcd__vquat_load(cut->end.seen + l, NSVCD__ENDS);
    nsvcd__cut_arc(m, &end, seen, l, out, cut);
    nsvcd__cut_deviations(m, lengths, l, out, &cut->most);
  }
  // the rest meet nothing
  for (size_t l = count; l < NSVCD__LANES; l++) out->margin[l] = NSVCD__NOWHERE;
}

// ---- all segments

// Cuts the chosen segments. lengths: the bodies' extents; clearance: spheres that come so near
// count as meeting.
static void nsvcd__cut_segments(const nsvcd__motion *m, float lengths, float clearance,
                                nsvcd__search *q) {
  uint32_t *begin = q->begin;
  float *turn = q->turn;
  // segments of no length fill the last block
  for (size_t s = q->segments; s % NSVCD__LANES; s++) begin[s + 1] = begin[s];
  turn[0] = 0;
  for (size_t s = 0; s < q->segments; s += NSVCD__LANES) {
    nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
    nsvcd__cut_block(m, begin + s, q->segments - s, lengths, block, q->cut);
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      block->margin[l] += clearance;
      turn[s + l + 1] = turn[s + l] + q->cut->most.turn[l];
    }
  }
}

#ifndef NSVCD_NO_NETWORK
// Chooses and cuts the segments of all of a motion.
static NSVCD__NOINLINE void nsvcd__cut_motion(nsvcd__motion *m, float lengths,
                                              nsvcd__search *q) {
  nsvcd__choose_all(m, q);
  nsvcd__cut_segments(m, lengths, 0, q);
}
#endif
