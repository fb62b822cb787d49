// In: two states, places and speeds of the joints, and limits of speed and acceleration. Out: a
// motion from one to the other in the least time of the slowest joint, each of the others with the
// least acceleration that takes as long.
//
// A joint speeds up, and down again, or the other way round; where it would be too fast in between,
// it goes on at the limit. What it does is of degree 2 piece by piece.
// Source: Hauser and Ng-Thow-Hing (2010).
#pragma once
#include "rrt.h"

// of a blend: each joint has two times at which its acceleration changes
#define NSVCD__BLEND_PIECES (2 * NSVCD_MAX_JOINTS + 1)
// share of the limits of speed and acceleration that is asked for: the rest is for rounding
#define NSVCD__BLEND_FRACTION (1 - 1e-6)
#define NSVCD__BLEND_MOST (1 - 5e-7)
// seconds: of shorter pieces rounding would say what their acceleration is; there are none. And two
// changes no farther apart than that are one
#define NSVCD__SLIVER 1e-4
#define NSVCD__SAME_TIME 1e-12

static double nsvcd__speed_of(const nsvcd_joint *joint) {
  return joint->speed > 0 ? joint->speed : 1;
}
static double nsvcd__acceleration_of(const nsvcd_joint *joint) {
  return joint->acceleration > 0 ? joint->acceleration : 1;
}

// A joint's way in a blend: acceleration a until t1, none until t2, -a after that.
typedef struct nsvcd__blend_joint {
  double a, t1, t2;
} nsvcd__blend_joint;

// The least time from place x0 and speed v0 to x1 and v1, both within the limits.
static double nsvcd__blend_time(double x0, double v0, double x1, double v1, double speed,
                                double most) {
  const double distance = x1 - x0;
  // changing speed takes this way: is there more to go, or less?
  const double least = 0.5 * (v0 + v1) * fabs(v1 - v0) / most;
  const double side = distance >= least ? 1 : -1;
  const double peak2 = side * most * distance + 0.5 * (v0 * v0 + v1 * v1);
  const double peak = side * sqrt(nsvcd__max(peak2, 0));
  if (fabs(peak) <= speed) return (fabs(peak - v0) + fabs(peak - v1)) / most;
  const double fast = side * speed;
  const double changing = (speed * speed - 0.5 * (v0 * v0 + v1 * v1)) / (side * most);
  return (fabs(fast - v0) + fabs(fast - v1)) / most +
         nsvcd__max((distance - changing) / fast, 0);
}

// The way with the least acceleration that takes this time. Returns 0 if there is none within the
// limits.
static int nsvcd__blend_solve(double x0, double v0, double x1, double v1, double speed,
                              double most, double time, nsvcd__blend_joint *out) {
  const double distance = x1 - x0;
  const double change = v1 - v0;
  // time^2 a^2 + b a - change^2 = 0: the root of the greater size
  const double b = 2 * time * (v0 + v1) - 4 * distance;
  const double root = sqrt(b * b + 4 * time * time * change * change);
  double a = -(b + (b > 0 ? root : -root)) / (2 * time * time);
  out->t1 = 0.5 * time;
  if (a > 0 || a < 0) out->t1 += 0.5 * change / a;
  out->t1 = nsvcd__max(0, nsvcd__min(time, out->t1));
  out->t2 = out->t1;
  const double peak = v0 + a * out->t1;
  if (fabs(peak) > speed) {
    const double fast = peak > 0 ? speed : -speed;
    const double up = (fast - v0) * (fast - v0) + (fast - v1) * (fast - v1);
    a = up / (2 * (fast * time - distance));
    if (!(a * fast > 0)) return 0;
    out->t1 = (fast - v0) / a;
    out->t2 = time - (fast - v1) / a;
    if (!(out->t1 >= 0 && out->t2 >= out->t1 && out->t2 <= time)) return 0;
  }
  out->a = a;
  return fabs(a) <= most;
}

// Place and speed at a time of a way that begins with x0 and v0.
static void nsvcd__blend_at(const nsvcd__blend_joint *r, double x0, double v0, double t,
                            double *x, double *v) {
  const double up = nsvcd__min(t, r->t1);
  const double even = nsvcd__max(nsvcd__min(t, r->t2) - r->t1, 0);
  const double down = nsvcd__max(t - r->t2, 0);
  const double fast = v0 + r->a * up;
  *x = x0 + (0.5 * (v0 + fast)) * up + fast * even + (fast - 0.5 * r->a * down) * down;
  *v = fast - r->a * down;
}

// Does a joint turn round out of its limits on the way? Its ends are within.
static int nsvcd__blend_leaves(const nsvcd_joint *joint, const nsvcd__blend_joint *r,
                               double x0, double v0, double time) {
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return 0;
  // where it stands still
  const double turns[2] = {
      r->a * v0 < 0 ? -v0 / r->a : 0,
      r->a * (v0 + r->a * r->t1) > 0 ? r->t2 + (v0 + r->a * r->t1) / r->a : 0};
  for (size_t k = 0; k < 2; k++) {
    double x, v;
    const int is_there = k ? turns[k] > r->t2 && turns[k] < time : turns[k] < r->t1;
    if (!is_there || !(turns[k] > 0)) continue;
    nsvcd__blend_at(r, x0, v0, turns[k], &x, &v);
    if (x < joint->low || x > joint->high) return 1;
  }
  return 0;
}

// Writes a blend of all joints as pieces: points (2 pieces + 1, F), times from 0. state: the joints
// at the start and the end, and their speeds (4, F). Returns the pieces; 0 if there is no blend
// within the limits that takes less than `longest`, or two of its changes nearly coincide.
static size_t nsvcd__blend_write(const nsvcd_scene *scene, double states[4][NSVCD_MAX_JOINTS],
                                 double longest, double *points, double *times) {
  const size_t joints = scene->joint_count;
  nsvcd__blend_joint blends[NSVCD_MAX_JOINTS];
  double changes[NSVCD__BLEND_PIECES + 1];
  size_t count = 0;
  double time = 0;
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    time = nsvcd__max(
        time, nsvcd__blend_time(states[0][j], states[2][j], states[1][j], states[3][j],
                                NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint),
                                NSVCD__BLEND_FRACTION * nsvcd__acceleration_of(joint)));
  }
  if (!(time < longest)) return 0;
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    const double speed = NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint);
    const double most = NSVCD__BLEND_MOST * nsvcd__acceleration_of(joint);
    if (!nsvcd__blend_solve(states[0][j], states[2][j], states[1][j], states[3][j], speed,
                            most, time, &blends[j]))
      return 0;
    if (nsvcd__blend_leaves(joint, &blends[j], states[0][j], states[2][j], time)) return 0;
    changes[count++] = blends[j].t1;
    changes[count++] = blends[j].t2;
  }
  changes[count++] = time;
  // sorted, by insertion
  for (size_t k = 1; k < count; k++) {
    const double own = changes[k];
    size_t at = k;
    for (; at > 0 && changes[at - 1] > own; at--) changes[at] = changes[at - 1];
    changes[at] = own;
  }
  size_t pieces = 0;
  times[0] = 0;
  memcpy(points, states[0], joints * sizeof *points);
  for (size_t k = 0; k < count; k++) {
    if (changes[k] - times[pieces] <= NSVCD__SAME_TIME) continue;
    if (changes[k] - times[pieces] < NSVCD__SLIVER) return 0;
    const double before = times[pieces];
    const double half = 0.5 * (changes[k] - before);
    double *to = points + 2 * pieces * joints;
    for (size_t j = 0; j < joints; j++) {
      double x, v;
      nsvcd__blend_at(&blends[j], states[0][j], states[2][j], before, &x, &v);
      to[joints + j] = to[j] + half * v;
      nsvcd__blend_at(&blends[j], states[0][j], states[2][j], changes[k], &x, &v);
      to[2 * joints + j] = x;
    }
    times[++pieces] = changes[k];
  }
  memcpy(points + 2 * pieces * joints, states[1], joints * sizeof *points);
  return pieces;
}
