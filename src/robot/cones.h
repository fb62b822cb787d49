// In: a scene's cones, and a motion, or a configuration. Out: does each axis stay in its cone? A
// configuration near by in which all do.
//
// THE BOUND. An axis is off a direction by no more than an angle where its product with it is no
// less than the angle's cosine: in a half space. In a step of the joints, if both its ends are in
// the half space, so is the chord between them, and how far it leaves that chord is what
// robot/deviation.h says of a point of which r_j is 1 for joints that turn, 0 for those that slide:
//   (sum_j max |e''_j| + (sum_j |d_j|)^2) / 8
#pragma once
#include "checker.h"

// of the product of two directions: rounding, of 32 joints and in proportion if there are more; by
// radian that a joint has turned; and what a step is not cut further for, unless the product
// changes in it by more than a share of that, and by more than noise
#define NSVCD__CONE_ROUNDING 1e-13
#define NSVCD__CONE_TURNED 1e-15
#define NSVCD__CONE_FINEST 1e-10
#define NSVCD__CONE_CHANGE 1e-3
#define NSVCD__CONE_NOISE 1e-15
// steps between two questions whether to stop
#define NSVCD__CONE_POLL 64
// steps of a projection; by how much farther each goes, in all, and in proportion; and the least
// square of a slope that leads anywhere
#define NSVCD__CONE_STEPS 20
#define NSVCD__CONE_BEYOND 1e-6
#define NSVCD__CONE_FARTHER 1.01
#define NSVCD__CONE_SLOPE 1e-6

// ---- motions

// By how much the product of an axis with its direction is above the cosine of its cone's angle; if
// it is between -*error and *error, that is not known.
static double nsvcd__cone_margin(const nsvcd_checker *c, const nsvcd__kept_axis *cone,
                                 const double *q, double *error) {
  nsvcd__d3 axis = cone->axis;
  *error = NSVCD__CONE_ROUNDING * nsvcd__max(1, (double)c->scene->joint_count / 32);
  for (size_t link = cone->link; link > 0; link = nsvcd__link_before(c, link)) {
    const nsvcd__dpose frame = nsvcd__joint_frame(c, link - 1, q[link - 1]);
    axis = nsvcd__dquat_rotate(frame.rotation, axis);
    if (!nsvcd__slides(c, link - 1)) *error += NSVCD__CONE_TURNED * fabs(q[link - 1]);
  }
  return nsvcd__d3_dot(axis, cone->direction) - cos(cone->angle);
}

// The bound of the banner.
static double nsvcd__axis_deviation(const nsvcd_checker *c, const nsvcd__kept_axis *cone,
                                    const nsvcd__step *step) {
  double bend = 0;
  double turned = 0;
  for (size_t link = cone->link; link > 0; link = nsvcd__link_before(c, link)) {
    if (nsvcd__slides(c, link - 1)) continue;
    bend += step->bend[link - 1];
    turned += step->travel[link - 1];
  }
  return (bend + turned * turned) / 8 * (1 + 1e-9);
}

// Does an axis stay in its cone from time t0 to t1, of which the steps are as long as can be?
// Returns FREE; HIT at *at, where it does not; or UNDECIDED from there on, and why. What leads into
// a cone from its edge, or out to it, takes few steps: margins grow, or shrink, in proportion.
static nsvcd_verdict nsvcd__ask_cone(const nsvcd_checker *c, const nsvcd__kept_axis *cone,
                                     const nsvcd_joint_motion *m, double t0, double t1,
                                     const nsvcd_check_options *o, double *at,
                                     nsvcd_why *why) {
  const size_t joints = c->scene->joint_count;
  double length = t1 - t0;
  nsvcd__step step;
  double error, last_error;
  size_t polls = 0;
  *why = NSVCD_WHY_TOO_NEAR;
  *at = t0;
  nsvcd__joints_at_time(m, joints, t0, step.from, NULL);
  double last = nsvcd__cone_margin(c, cone, step.from, &last_error);
  if (last < last_error) return last < -last_error ? NSVCD_HIT : NSVCD_UNDECIDED;
  while (*at < t1) {
    if (++polls % NSVCD__CONE_POLL == 0 && o->stop && o->stop(o->user)) {
      *why = NSVCD_WHY_WORK;
      return NSVCD_UNDECIDED;
    }
    const double to = *at + length < t1 ? *at + length : t1;
    nsvcd__step_of(m, joints, *at, to, &step);
    const double next = nsvcd__cone_margin(c, cone, step.to, &error);
    const double deviation = nsvcd__axis_deviation(c, cone, &step);
    const double least = nsvcd__min(last - last_error, next - error);
    if (least >= deviation) {
      *at = to;
      last = next;
      last_error = error;
      length *= 2;
      continue;
    }
    length = 0.5 * (to - *at);
    if (next < -error) {
      *at = to;
      return NSVCD_HIT;
    }
    const double least_change = nsvcd__max(NSVCD__CONE_CHANGE * deviation, NSVCD__CONE_NOISE);
    const int stays = deviation <= NSVCD__CONE_FINEST && fabs(next - last) <= least_change;
    if (stays || !(*at + length > *at && *at + length < to)) return NSVCD_UNDECIDED;
  }
  return NSVCD_FREE;
}

// Do all axes stay in their cones from time t0 to t1? Else the answer says which one does not, or
// that the options' `stop` ended that, by NSVCD_WHY_WORK.
static int nsvcd__keeps_cones(const nsvcd_checker *c, const nsvcd_joint_motion *m, double t0,
                              double t1, const nsvcd_check_options *o,
                              nsvcd_check_answer *answer) {
  answer->cone = NSVCD_NONE;
  for (size_t n = 0; n < c->scene->cone_count; n++) {
    double at;
    nsvcd_why why;
    answer->verdict = nsvcd__ask_cone(c, &c->cones[n], m, t0, t1, o, &at, &why);
    if (answer->verdict == NSVCD_FREE) continue;
    memset(&answer->contact, 0, sizeof answer->contact);
    answer->cone = n;
    answer->pair = NSVCD_NONE;
    answer->why = answer->verdict == NSVCD_HIT ? NSVCD_WHY_NOTHING : why;
    answer->piece = nsvcd__piece_at(m, at);
    answer->fraction = nsvcd__fraction_at(m, answer->piece, at);
    return 0;
  }
  return 1;
}

// ---- configurations

// A joint's limits; of one that turns without, as far as values may go.
static double nsvcd__low_of(const nsvcd_joint *joint) {
  const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
  return is_endless ? -(double)NSVCD_MAX_COORDINATE : joint->low;
}
static double nsvcd__high_of(const nsvcd_joint *joint) {
  const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
  return is_endless ? (double)NSVCD_MAX_COORDINATE : joint->high;
}

static void nsvcd__clamp_to_limits(const nsvcd_scene *scene, double *joints) {
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    joints[j] = nsvcd__max(nsvcd__low_of(joint), nsvcd__min(nsvcd__high_of(joint), joints[j]));
  }
  nsvcd__follow(scene, 1, joints);
}

// The rotation vector of a turn that takes unit vector a to b. Of opposite ones it is about any
// axis across.
static nsvcd__d3 nsvcd__turn_between(nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 across = nsvcd__d3_cross(a, b);
  const double sine = nsvcd__d3_norm(across);
  const double cosine = nsvcd__d3_dot(a, b);
  if (sine > 1e-12) return nsvcd__d3_scale(across, nsvcd__atan2(sine, cosine) / sine);
  if (cosine > 0) return across;
  const nsvcd__d3 other = nsvcd__d3_of(fabs(a.x) < 0.6, fabs(a.x) >= 0.6, 0);
  const nsvcd__d3 axis = nsvcd__d3_cross(a, other);
  return nsvcd__d3_scale(axis, 3.141592653589793 / nsvcd__d3_norm(axis));
}

// How far axes are out of their cones, each narrowed to this share of its angle: radians, the root
// of the sum of their squares. slope: (F) by each joint, with those that it drives. *is_in: is each
// in its cone, and half way to the narrowed one?
static double nsvcd__cones_excess(nsvcd_checker *c, const double *q, double share,
                                  double *slope, int *is_in) {
  const size_t joints = c->scene->joint_count;
  double squares = 0;
  memset(slope, 0, joints * sizeof *slope);
  *is_in = 1;
  if (c->scene->cone_count > 0) nsvcd__place_links(c, q, c->at);
  for (size_t n = 0; n < c->scene->cone_count; n++) {
    const nsvcd__kept_axis *cone = &c->cones[n];
    const nsvcd__dpose *frame = &c->at->frames[cone->link];
    const nsvcd__d3 axis = nsvcd__dquat_rotate(frame->rotation, cone->axis);
    const nsvcd__d3 turn = nsvcd__turn_between(cone->direction, axis);
    const double angle = nsvcd__d3_norm(turn);
    const double excess = angle - share * cone->angle;
    if (!(excess > 0)) continue;
    *is_in &= angle <= 0.5 * (1 + share) * cone->angle;
    squares += excess * excess;
    for (size_t link = cone->link; link > 0; link = nsvcd__link_before(c, link)) {
      const double by = nsvcd__d3_dot(turn, c->at->axes[link - 1]) / angle;
      const size_t driver = nsvcd__driver(c->scene, link - 1);
      if (!nsvcd__slides(c, link - 1))
        slope[driver] += excess * by * nsvcd__rate(c->scene, link - 1);
    }
  }
  const double out = sqrt(squares);
  for (size_t j = 0; j < joints && out > 0; j++) slope[j] /= out;
  return out;
}

// Moves a configuration until all axes are in their cones, each narrowed to this share: Newton's
// method, by the least change of the joints that are not held. Returns 0 if that leads nowhere.
static int nsvcd__into_cones(nsvcd_checker *c, const uint8_t *held, double share, double *q) {
  double slope[NSVCD_MAX_JOINTS];
  int is_in;
  for (size_t n = 0; n < NSVCD__CONE_STEPS; n++) {
    const double excess = nsvcd__cones_excess(c, q, share, slope, &is_in);
    double squares = 0;
    if (is_in) return 1;
    for (size_t j = 0; j < c->scene->joint_count; j++)
      squares += held && held[j] ? 0 : slope[j] * slope[j];
    if (!(squares > NSVCD__CONE_SLOPE)) return 0;
    const double step = (NSVCD__CONE_FARTHER * excess + NSVCD__CONE_BEYOND) / squares;
    for (size_t j = 0; j < c->scene->joint_count; j++)
      q[j] -= held && held[j] ? 0 : step * slope[j];
    nsvcd__clamp_to_limits(c->scene, q);
  }
  return 0;
}
