// In: a motion, an arc of it and a fraction u in [0,1] of the arc. Out: the pose of the moving body
// there, in double, to the last digits.
#pragma once
#include "../proof/proof.h"

#ifndef NSVCD_NO_PROOF
// The inverse of a pose, whose rotation is times this scale.
static nsvcd__dtransform nsvcd__inverse_dtransform(const nsvcd__dtransform *at, double scale) {
  const double inverse = 1 / (scale * scale);
  nsvcd__dtransform out;
  const nsvcd__dmat3 transpose = nsvcd__dmat3_transpose(at->rotation);
  out.rotation = nsvcd__dmat3_scale(&transpose, inverse);
  out.position = nsvcd__d3_scale(nsvcd__dmat3_apply(&out.rotation, at->position), -1);
  return out;
}

// A track's slerp over an arc, and its pivot's positions at both ends, metres.
static nsvcd__slerp nsvcd__slerp_in(const nsvcd__track *track, uint32_t first, uint32_t ticks,
                                    nsvcd__d3 *ends) {
  const uint32_t k = nsvcd__pose_before(track, first);
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = track->count > 1 ? a + 1 : a;
  const uint32_t begin = nsvcd__tick_of(track, k);
  const double per_tick = 1 / (double)(nsvcd__tick_of(track, k + 1) - begin);
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  const nsvcd__d3 start = nsvcd__pivot_of(a, pivot);
  const nsvcd__d3 end = nsvcd__pivot_of(b, pivot);
  nsvcd__slerp out = nsvcd__slerp_of(a, b);
  out.fraction = (double)ticks * per_tick;
  out.from = (double)(first - begin) * per_tick;
  ends[0] = nsvcd__d3_mix(start, end, out.from);
  ends[1] = nsvcd__d3_mix(start, end, out.from + out.fraction);
  return out;
}

// Does the moving body turn, or the fixed one move? If not, the rotation stays that at the start.
static int nsvcd__turns(const nsvcd__arc *arc) {
  return arc->turn > 0 || arc->fixed_moves;
}

// The arc that begins at the keyframe `first`.
static const nsvcd__arc *nsvcd__arc_at(nsvcd__arcs *arcs, uint32_t first) {
  const nsvcd__motion *m = arcs->motion;
  nsvcd__arc *arc = &arcs->arc;
  const uint32_t ticks = nsvcd__next_keyframe(m, first) - first;
  if (arc->first == first && arc->ticks == ticks) return arc;
  nsvcd__d3 ends[2], fixed_ends[2];
  const double per_metre = 1 / (double)m->unit;
  arc->first = first;
  arc->ticks = ticks;
  arc->fixed_moves = m->fixed_moves;
  arc->scale = m->ratio;
  const nsvcd__d3 fixed_pivot = nsvcd__d3_scale(nsvcd__track_pivot(&m->fixed), per_metre);
  arc->added = nsvcd__d3_add(fixed_pivot, nsvcd__d3_widen(m->push_out));
  arc->pivot = nsvcd__d3_scale(nsvcd__track_pivot(&m->moving), per_metre);
  arc->moving = nsvcd__slerp_in(&m->moving, first, ticks, ends);
  arc->fixed = nsvcd__slerp_in(&m->fixed, first, ticks, fixed_ends);
  const nsvcd__d3 from = nsvcd__d3_sub(ends[0], fixed_ends[0]);
  const nsvcd__d3 to = nsvcd__d3_sub(ends[1], fixed_ends[1]);
  arc->from = nsvcd__d3_scale(from, per_metre);
  arc->moved = nsvcd__d3_scale(nsvcd__d3_sub(to, from), per_metre);
  if (!arc->fixed_moves) {
    // all in the fixed body's frame
    const nsvcd__dquat back = nsvcd__dquat_inverse(arc->fixed.start);
    const nsvcd__dmat3 axes = nsvcd__dmat3_of(arc->fixed.start);
    const nsvcd__dquat none = {0, 0, 0, 1};
    arc->moving.start = nsvcd__dquat_mul(back, arc->moving.start);
    arc->moving.end = nsvcd__dquat_mul(back, arc->moving.end);
    arc->from = nsvcd__dmat3_apply_transpose(&axes, arc->from);
    arc->moved = nsvcd__dmat3_apply_transpose(&axes, arc->moved);
    arc->fixed.start = arc->fixed.end = none;
  }

  // the bounds of nsvcd__cut_double_arc; of one body that turns, twist and swing are 0
  const nsvcd__d3 fixed_turn = nsvcd__slerp_turn(&arc->fixed);
  const nsvcd__d3 turn = nsvcd__d3_sub(nsvcd__slerp_turn(&arc->moving), fixed_turn);
  const nsvcd__d3 end = nsvcd__d3_add(arc->from, arc->moved);
  const double twist = nsvcd__d3_norm(nsvcd__d3_cross(turn, fixed_turn));
  const double angle = nsvcd__d3_norm(fixed_turn);
  const double swing_from = nsvcd__d3_norm(nsvcd__d3_cross(fixed_turn, arc->from));
  const double swing_to = nsvcd__d3_norm(nsvcd__d3_cross(fixed_turn, end));
  const double swing = nsvcd__max(swing_from, swing_to);
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(fixed_turn, arc->moved));
  const nsvcd__d3 axis = nsvcd__d3_unit(turn, nsvcd__d3_of(1, 0, 0));
  const nsvcd__dmat3 fixed = nsvcd__dmat3_of(nsvcd__slerp_at(&arc->fixed, 0));
  const nsvcd__dmat3 moving = nsvcd__dmat3_of(nsvcd__slerp_at(&arc->moving, 0));
  const double arm = nsvcd__d3_norm(arc->pivot);
  arc->turn = nsvcd__d3_norm(turn);
  if (!nsvcd__turns(arc)) arc->moving.start = nsvcd__slerp_at(&arc->moving, 0);
  arc->speed = nsvcd__d3_norm(arc->moved) + swing + arc->turn * arm;
  arc->twist = 0.1250001 * arc->scale * twist;
  arc->origin_bend = 0.1250001 * (2 * across + angle * swing);
  arc->origin_bend += 0.1250001 * arm * (arc->turn * arc->turn + twist);
  arc->axis = nsvcd__dmat3_apply_transpose(&fixed, axis);
  arc->own_axis = nsvcd__dmat3_apply_transpose(&moving, axis);
  arc->waver = arc->turn > 0 ? nsvcd__min(1, twist / arc->turn) : 0;
  arc->bend = 0.1250001 * arc->scale * arc->turn * arc->turn;
  return arc;
}

// Do all points of the moving body go along straight lines, as the fixed body sees them?
static int nsvcd__is_straight(const nsvcd__arc *arc) {
  return !(arc->bend > 0 || arc->twist > 0 || arc->origin_bend > 0);
}

// The true pose at fraction u of the arc, as the fixed body sees it. Its rotation is times the
// moving body's scale.
static nsvcd__dtransform nsvcd__dtransform_at(const nsvcd__arc *arc, double u) {
  nsvcd__dquat q = nsvcd__turns(arc) ? nsvcd__slerp_at(&arc->moving, u) : arc->moving.start;
  nsvcd__dtransform at;
  at.position = nsvcd__d3_add(arc->from, nsvcd__d3_scale(arc->moved, u));
  if (arc->fixed_moves) {
    const nsvcd__dquat fixed = nsvcd__slerp_at(&arc->fixed, u);
    const nsvcd__dmat3 matrix = nsvcd__dmat3_of(fixed);
    q = nsvcd__dquat_mul(nsvcd__dquat_inverse(fixed), q);
    at.position = nsvcd__dmat3_apply_transpose(&matrix, at.position);
  }
  const nsvcd__dmat3 rotation = nsvcd__dmat3_of(q);
  at.rotation = nsvcd__dmat3_scale(&rotation, arc->scale);
  at.position = nsvcd__d3_add(at.position, arc->added);
  at.position = nsvcd__d3_sub(at.position, nsvcd__dmat3_apply(&rotation, arc->pivot));
  return at;
}

// The true pose at fraction u of p->arc, remembered: triangle pairs ask for the same poses again.
// The pose of the call before stays where it is.
static const nsvcd__dtransform *nsvcd__arc_pose(nsvcd__arcs *arcs, double u) {
  const nsvcd__arc *arc = &arcs->arc;
  const size_t next = arcs->next;
  size_t n = 0;
  for (; n < NSVCD__KNOWN_POSES; n++) {
    const nsvcd__known_pose *known = &arcs->poses[n];
    if (known->arc == arc->first && known->ticks == arc->ticks && known->u == u) break;
  }
  if (n == NSVCD__KNOWN_POSES) {
    n = next;
    arcs->poses[n].transform = nsvcd__dtransform_at(arc, u);
    arcs->poses[n].arc = arc->first;
    arcs->poses[n].ticks = arc->ticks;
    arcs->poses[n].u = u;
  }
  if (n == next) arcs->next = (n + 1) % NSVCD__KNOWN_POSES;
  return &arcs->poses[n].transform;
}

static nsvcd__transform nsvcd__transform_of(const nsvcd__dtransform *at) {
  nsvcd__transform out;
  out.rotation.x = nsvcd__d3_narrow(at->rotation.x);
  out.rotation.y = nsvcd__d3_narrow(at->rotation.y);
  out.rotation.z = nsvcd__d3_narrow(at->rotation.z);
  out.position = nsvcd__f3_round(at->position);
  return out;
}

static void nsvcd__pose_triangle(const nsvcd__dtransform *at, const nsvcd__d3 *corners,
                                 nsvcd__d3 *out) {
  for (size_t k = 0; k < 3; k++) out[k] = nsvcd__d3_transform(at, corners[k]);
}
#endif  // NSVCD_NO_PROOF
