// In: a segment, or an arc and two fractions of it. Out: an interval: the poses at both ends, and
// how far points deviate from their chords in between.
#pragma once
#include "../motion/choice.h"
#include "poses.h"

#ifndef NSVCD_NO_PROOF
// A segment, up to the end of what matters; kept once it has been made.
static const nsvcd__interval *nsvcd__segment_interval(nsvcd__solver *w, const nsvcd__search *q,
                                                      size_t s) {
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  nsvcd__interval *out = &w->intervals[s];
  if (w->memo.intervals >> s & 1) return out;
  w->memo.intervals |= (uint64_t)1 << s;
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, l);
  out->start.rotation = nsvcd__mat3_lane(block->rotation, l);
  out->end.rotation = nsvcd__mat3_mix(1, &out->start.rotation, 1, &turned);
  out->start.position = nsvcd__lane_of(block->position, l);
  out->end.position = nsvcd__f3_add(out->start.position, nsvcd__lane_of(block->moved, l));
  out->bend = block->bend[l];
  out->rounding = block->rounding[l];
  out->origin_bend = block->origin_bend[l];
  out->axis = nsvcd__lane_of(block->axis, l);
  out->heading = nsvcd__lane_of(block->heading, l);
  out->bend_along_axis = block->bend_along_axis[l];
  out->origin_along_axis = block->origin_along_axis[l];
  out->origin_off_heading = block->origin_off_heading[l];
  return out;
}

// The interval from u0 to u1 of the arc that begins at the keyframe `first`.
static nsvcd__interval nsvcd__interval_of_arc(nsvcd__proof *p, uint32_t first, double u0,
                                              double u1) {
  const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, first);
  const nsvcd__dtransform *start = nsvcd__arc_pose(&p->arcs, u0);
  const nsvcd__dtransform *end = nsvcd__arc_pose(&p->arcs, u1);
  const double square = (u1 - u0) * (u1 - u0);
  nsvcd__interval out;
  out.start = nsvcd__transform_of(start);
  out.end = nsvcd__transform_of(end);
  const float extent_start = nsvcd__f3_norm(out.start.position);
  const float extent = extent_start + nsvcd__f3_norm(out.end.position);
  out.bend = (float)(square * (arc->bend + arc->twist) * 1.000001);
  out.origin_bend = (float)(square * arc->origin_bend * 1.000001);
  out.rounding = NSVCD__ROUNDING * (extent + p->given.lengths);
  out.origin_along_axis = out.origin_off_heading = out.origin_bend;
  out.axis = nsvcd__f3_round(arc->axis);
  out.heading = out.axis;  // any
  const double wavers = square * (arc->bend * arc->waver + arc->twist);
  out.bend_along_axis = fminf((float)wavers + 1e-6f * out.bend, out.bend);
  return out;
}

// Does any point leave its chord?
static int nsvcd__may_bend(const nsvcd__interval *over) {
  return over->bend > 0 || over->origin_bend > 0;
}

// The axis in the moving body's frame, unit.
static nsvcd__f3 nsvcd__own_axis(const nsvcd__interval *over) {
  const nsvcd__f3 axis = nsvcd__mat3_apply_transpose(&over->start.rotation, over->axis);
  const float length = nsvcd__f3_norm(axis);
  return nsvcd__f3_scale(axis, length > 0 ? 1 / length : 0);
}

// How far points of the moving body are, at most, in its own units: from its origin, and from the
// line through that along the axis of a turn.
typedef struct nsvcd__arm {
  float from_origin, from_axis;
} nsvcd__arm;

// Of a sphere. axis: unit to rounding, in the body's frame.
static nsvcd__arm nsvcd__arm_of(nsvcd__f3 centre, float radius, nsvcd__f3 axis) {
  const float distance = nsvcd__f3_norm(centre);
  const float aside = nsvcd__f3_norm(nsvcd__f3_cross(centre, axis));
  const nsvcd__arm out = {1.000001f * (distance + radius),
                          1.000001f * (aside + radius) + 1e-6f * distance};
  return out;
}

// Of a patch's pieces; none where nothing bends.
static nsvcd__arm nsvcd__patch_arm(const nsvcd__geometry *f, size_t patch,
                                   const nsvcd__interval *over) {
  const nsvcd__arm none = {0, 0};
  if (!nsvcd__may_bend(over)) return none;
  const float radius = nsvcd__body_r(f->body)[patch];
  return nsvcd__arm_of(nsvcd__patch_centre(f, patch), radius, nsvcd__own_axis(over));
}

// The deviation that the turn causes, along any direction: |D x|, with D the difference between the
// true rotation and the chord's at some time. Split x into its parts along a', the axis in the
// moving body's frame, and across it: then
//   |D x| <= |D| |x x a'| + |D a'| |x.a'|
// and |D a'| is |D^T axis|, since both ends of the chord take a' to the axis.
static float nsvcd__bend_of(const nsvcd__interval *over, nsvcd__arm arm) {
  const float by_axis = over->bend * arm.from_axis + over->bend_along_axis * arm.from_origin;
  return fminf(over->bend * arm.from_origin, by_axis);
}

// The deviation of points of the moving body along a direction n, times its length, without
// rounding (which is times |n| too). With d the difference of the positions, a point x is off by
// n.(D x + d). Split n into its parts along the axis and across it: then
//   |n.D x| <= |n.axis| |D^T axis| |x| + |n x axis| |D x|
// and |n.d| is bounded in the same way, or with the heading in place of the axis.
static float nsvcd__deviation_of(const nsvcd__interval *over, nsvcd__f3 n, nsvcd__arm arm) {
  if (!nsvcd__may_bend(over)) return 0;
  const float along = fabsf(nsvcd__f3_dot(n, over->axis));
  const float across = nsvcd__f3_norm(nsvcd__f3_cross(n, over->axis));
  const float ahead = fabsf(nsvcd__f3_dot(n, over->heading));
  const float aside = nsvcd__f3_norm(nsvcd__f3_cross(n, over->heading));
  const float by_axis = along * over->origin_along_axis + across * over->origin_bend;
  const float by_heading = ahead * over->origin_bend + aside * over->origin_off_heading;
  const float origin_bend = by_axis < by_heading ? by_axis : by_heading;
  const float turn = along * over->bend_along_axis * arm.from_origin;
  return origin_bend + turn + across * nsvcd__bend_of(over, arm);
}

#endif  // NSVCD_NO_PROOF
