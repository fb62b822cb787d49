// In: poses, as a caller gives them. Out: in double, where a body is between two of them, and how
// it turns on the way: its rotation is a slerp on the shorter arc, and the position of its pivot
// linear. With the pivot c of the body's frame, scaled, the pivot of a pose is at position + R c.
//
// This is the law of motion, for proofs, certificates and robots. The floor of motions has it again
// in float, 16 segments at a time: every query cuts its motion, and poses in double alone would
// take longer than that.
#pragma once
#include "../interface/queries.h"
#include "rotations.h"

// A pose in double. Its rotation is of any length.
typedef struct nsvcd__dpose {
  nsvcd__dquat rotation;
  nsvcd__d3 position;
} nsvcd__dpose;

static inline nsvcd__dpose nsvcd__dpose_of(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dpose out = {{(double)q[0], (double)q[1], (double)q[2], (double)q[3]},
                            nsvcd__d3_load(pose->position)};
  return out;
}

// With a unit rotation.
static inline nsvcd__dpose nsvcd__unit_dpose(const nsvcd_pose *pose) {
  nsvcd__dpose out = nsvcd__dpose_of(pose);
  out.rotation = nsvcd__dquat_unit(out.rotation);
  return out;
}

static inline nsvcd__dtransform nsvcd__dtransform_of(const nsvcd__dpose *pose) {
  const nsvcd__dtransform out = {nsvcd__dmat3_of(nsvcd__dquat_unit(pose->rotation)),
                                 pose->position};
  return out;
}

static inline nsvcd_pose nsvcd__dpose_round(const nsvcd__dpose *pose) {
  const nsvcd__dquat turn = nsvcd__dquat_unit(pose->rotation);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__f3_round(pose->position), out.position);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__dquat_axis(turn)), out.rotation);
  out.rotation[3] = nsvcd__to_float(turn.w);
  return out;
}

// Is the shorter arc from a to b the one to -b?
static inline int nsvcd__poses_opposed(const nsvcd_pose *a, const nsvcd_pose *b) {
  return nsvcd__quats_opposed(nsvcd__quat_load(a->rotation), nsvcd__quat_load(b->rotation));
}

// The length of the arc from a to b, both unit, in quaternion space: half the angle of the turn.
static inline double nsvcd__dquat_arc(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__dquat difference = nsvcd__dquat_fma(-1, b, a);
  const nsvcd__dquat sum = nsvcd__dquat_fma(1, b, a);
  const double apart = sqrt(nsvcd__dquat_dot(difference, difference));
  return 2 * nsvcd__atan2(apart, sqrt(nsvcd__dquat_dot(sum, sum)));
}

// How a body turns from a pose to the next, or in a part of that time.
typedef struct nsvcd__slerp {
  // at the poses: unit, on the shorter side
  nsvcd__dquat start, end;
  double half_angle;  // between them as quaternions: half the angle of the turn
  // between the poses, 0 to 1: where the part begins, and its length
  double from, fraction;
} nsvcd__slerp;

// All of the turn from a to b.
static inline nsvcd__slerp nsvcd__slerp_of(const nsvcd_pose *a, const nsvcd_pose *b) {
  const double side = nsvcd__poses_opposed(a, b) ? -1 : 1;
  const nsvcd__dquat start = nsvcd__unit_dpose(a).rotation;
  const nsvcd__dquat end = nsvcd__unit_dpose(b).rotation;
  nsvcd__slerp out = {start, nsvcd__dquat_scale(end, side), 0, 0, 1};
  out.half_angle = nsvcd__dquat_arc(out.start, out.end);
  return out;
}

// The rotation at fraction u of the part, unit.
static inline nsvcd__dquat nsvcd__slerp_at(const nsvcd__slerp *s, double u) {
  const double along = s->from + s->fraction * u;
  return nsvcd__dquat_unit(nsvcd__dquat_along(s->start, s->end, s->half_angle, along));
}

// The rotation vector of the part. Points bend off their chords by an eighth of its square, per
// metre from its axis: a turn by h at a constant rate about a moves a point y with a second
// derivative of h^2 a x (a x y), by the fraction of the turn that has gone by. Along a direction n
// that is h^2 (n x a).(a x y).
static inline nsvcd__d3 nsvcd__slerp_turn(const nsvcd__slerp *slerp) {
  const nsvcd__d3 axis = nsvcd__dquat_turn(slerp->start, slerp->end);
  const double sine = nsvcd__d3_norm(axis);
  const double angle = 2 * slerp->half_angle * slerp->fraction;
  return nsvcd__d3_scale(axis, sine > 0 ? angle / sine : 0);
}

// From a pose's origin s times to its pivot c.
static inline nsvcd__d3 nsvcd__to_pivot(const nsvcd__dpose *pose, nsvcd__d3 c, double s) {
  if (!(nsvcd__d3_dot(c, c) > 0)) return pose->position;
  const nsvcd__dtransform at = nsvcd__dtransform_of(pose);
  return nsvcd__d3_transform(&at, nsvcd__d3_scale(c, s));
}

// The position of a pose's pivot c.
static inline nsvcd__d3 nsvcd__pivot_of(const nsvcd_pose *pose, nsvcd__d3 c) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  return nsvcd__to_pivot(&at, c, 1);
}

// The pose at fraction u between two, with the pivot c.
static inline nsvcd__dpose nsvcd__dpose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                nsvcd__d3 c, double u) {
  const nsvcd__slerp s = nsvcd__slerp_of(a, b);
  nsvcd__dpose out = {nsvcd__dquat_along(s.start, s.end, s.half_angle, u),
                      nsvcd__d3_mix(nsvcd__pivot_of(a, c), nsvcd__pivot_of(b, c), u)};
  out.position = nsvcd__to_pivot(&out, c, -1);
  return out;
}
