// In: two states, positions and speeds of the joints, and limits of speed and acceleration. Out: a
// motion from one to the other in the least time of the slowest joint; each other joint takes as
// long, with the least acceleration that does.
//
// A joint speeds up, and slows down again, or the other way round; where it would be too fast in
// between, it goes on at the limit. So it is of degree 2, piece by piece.
// Source: Hauser and Ng-Thow-Hing (2010).
#pragma once
#include "steps.h"

// of a blend: each joint has two times at which its acceleration changes
#define NSVCD__BLEND_PIECES (2 * NSVCD_MAX_JOINTS + 1)
// fractions of the limits of speed and acceleration that are asked for: the rest is for rounding
#define NSVCD__BLEND_FRACTION (1 - 1e-6)
#define NSVCD__BLEND_MOST (1 - 5e-7)
// seconds: no piece is shorter, for rounding would say what its acceleration is; changes of
// acceleration that are no farther apart than NSVCD__SAME_TIME are one
#define NSVCD__SLIVER 1e-4
#define NSVCD__SAME_TIME 1e-12

// A motion of degree 2 that is being made: `motion` has its arrays.
typedef struct nsvcd__trajectory {
  nsvcd_joint_motion motion;
  // (2 most pieces + 1, F)
  double *points;
  // (most pieces + 1)
  double *times;
} nsvcd__trajectory;

static void nsvcd__trajectory_begin(nsvcd__trajectory *t, size_t joints, const double *at) {
  const nsvcd_joint_motion motion = {0, 2, t->points, t->times};
  t->motion = motion;
  t->times[0] = 0;
  memcpy(t->points, at, joints * sizeof *at);
}

static double nsvcd__trajectory_end(const nsvcd__trajectory *t) {
  return t->times[t->motion.pieces];
}

// Adds a piece that ends at a time.
static void nsvcd__trajectory_add(nsvcd__trajectory *t, size_t joints, const double *middle,
                                  const double *end, double time) {
  double *at = t->points + (2 * t->motion.pieces + 1) * joints;
  memcpy(at, middle, joints * sizeof *at);
  memcpy(at + joints, end, joints * sizeof *at);
  t->times[++t->motion.pieces] = time;
}

// A joint in a blend: from position x0 at speed v0, acceleration a until t1, none until t2, -a
// after that.
typedef struct nsvcd__blend_joint {
  double x0, v0, a, t1, t2;
} nsvcd__blend_joint;

// The least time from position x0 and speed v0 to x1 and v1, both within the limits.
static double nsvcd__blend_time(double x0, double v0, double x1, double v1, double speed,
                                double most) {
  const double distance = x1 - x0;
  // a change of speed alone goes this far: is there more to go, or less?
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

// The blend with the least acceleration that takes this time. Returns 0 if there is none within
// the limits.
static int nsvcd__blend_solve(double x0, double v0, double x1, double v1, double speed,
                              double most, double time, nsvcd__blend_joint *out) {
  const double distance = x1 - x0;
  const double change = v1 - v0;
  // time^2 a^2 + b a - change^2 = 0: the root of the greater size
  const double b = 2 * time * (v0 + v1) - 4 * distance;
  const double root = sqrt(b * b + 4 * time * time * change * change);
  double a = -(b + (b > 0 ? root : -root)) / (2 * time * time);
  double t1 = 0.5 * time;
  if (a > 0 || a < 0) t1 += 0.5 * change / a;
  t1 = nsvcd__max(0, nsvcd__min(time, t1));
  double t2 = t1;
  const double peak = v0 + a * t1;
  if (fabs(peak) > speed) {
    const double fast = peak > 0 ? speed : -speed;
    const double up = (fast - v0) * (fast - v0) + (fast - v1) * (fast - v1);
    a = up / (2 * (fast * time - distance));
    if (!(a * fast > 0)) return 0;
    t1 = (fast - v0) / a;
    t2 = time - (fast - v1) / a;
    if (!(t1 >= 0 && t2 >= t1 && t2 <= time)) return 0;
  }
  const nsvcd__blend_joint solved = {x0, v0, a, t1, t2};
  *out = solved;
  return fabs(a) <= most;
}

// Position and speed at a time.
static void nsvcd__blend_at(const nsvcd__blend_joint *r, double t, double *x, double *v) {
  const double up = nsvcd__min(t, r->t1);
  const double even = nsvcd__max(nsvcd__min(t, r->t2) - r->t1, 0);
  const double down = nsvcd__max(t - r->t2, 0);
  const double fast = r->v0 + r->a * up;
  *x = r->x0 + (0.5 * (r->v0 + fast)) * up + fast * even + (fast - 0.5 * r->a * down) * down;
  *v = fast - r->a * down;
}

// Does a joint leave its limits in between, where it turns round? Both its ends are in them.
static int nsvcd__blend_leaves(const nsvcd_joint *joint, const nsvcd__blend_joint *r,
                               double time) {
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return 0;
  // where its speed is 0
  const double fast = r->v0 + r->a * r->t1;
  const double turns[2] = {r->a * r->v0 < 0 ? -r->v0 / r->a : 0,
                           r->a * fast > 0 ? r->t2 + fast / r->a : 0};
  for (size_t k = 0; k < 2; k++) {
    double x, v;
    const int is_there = k ? turns[k] > r->t2 && turns[k] < time : turns[k] < r->t1;
    if (!is_there || !(turns[k] > 0)) continue;
    nsvcd__blend_at(r, turns[k], &x, &v);
    if (x < joint->low || x > joint->high) return 1;
  }
  return 0;
}

// Joints and their speeds, (F).
typedef struct nsvcd__state {
  double x[NSVCD_MAX_JOINTS], v[NSVCD_MAX_JOINTS];
} nsvcd__state;

// Solves the blends of all joints. Returns the time that they take; 0 if there are none within the
// limits that take less than `longest`.
static double nsvcd__blend_joints(const nsvcd_scene *scene, const nsvcd__state *from,
                                  const nsvcd__state *to, double longest,
                                  nsvcd__blend_joint *out) {
  double time = 0;
  for (size_t j = 0; j < scene->joint_count; j++) {
    const double speed = NSVCD__BLEND_FRACTION * nsvcd__speed_of(&scene->joints[j]);
    const double most = NSVCD__BLEND_FRACTION * nsvcd__acceleration_of(&scene->joints[j]);
    const double own =
        nsvcd__blend_time(from->x[j], from->v[j], to->x[j], to->v[j], speed, most);
    time = nsvcd__max(time, own);
  }
  if (!(time < longest)) return 0;
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    const double speed = NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint);
    const double most = NSVCD__BLEND_MOST * nsvcd__acceleration_of(joint);
    if (joint->mimic) continue;
    if (!nsvcd__blend_solve(from->x[j], from->v[j], to->x[j], to->v[j], speed, most, time,
                            &out[j]) ||
        nsvcd__blend_leaves(joint, &out[j], time))
      return 0;
  }
  for (size_t j = 0; j < scene->joint_count; j++) {
    const double rate = nsvcd__rate(scene, j);
    const nsvcd__blend_joint *b = &out[nsvcd__driver(scene, j)];
    const nsvcd__blend_joint driven = {nsvcd__driven(scene, j, from->x), rate * b->v0,
                                       rate * b->a, b->t1, b->t2};
    if (scene->joints[j].mimic) out[j] = driven;
  }
  return time;
}

// Writes a blend of all joints. Returns 0 if there is none within the limits that takes less than
// `longest`, or two of its changes nearly coincide.
static int nsvcd__blend_write(const nsvcd_scene *scene, const nsvcd__state *from,
                              const nsvcd__state *to, double longest, nsvcd__trajectory *out) {
  const size_t joints = scene->joint_count;
  nsvcd__blend_joint blends[NSVCD_MAX_JOINTS];
  double changes[NSVCD__BLEND_PIECES];
  size_t count = 0;
  const double time = nsvcd__blend_joints(scene, from, to, longest, blends);
  if (!(time > 0)) return 0;
  // sorted, by insertion
  for (size_t n = 0; n <= 2 * joints; n++) {
    const double change = n == 2 * joints ? time : n % 2 ? blends[n / 2].t2 : blends[n / 2].t1;
    size_t at = count++;
    for (; at > 0 && changes[at - 1] > change; at--) changes[at] = changes[at - 1];
    changes[at] = change;
  }
  nsvcd__trajectory_begin(out, joints, from->x);
  for (size_t k = 0; k < count; k++) {
    const double before = nsvcd__trajectory_end(out);
    const double half = 0.5 * (changes[k] - before);
    const double *last = out->points + 2 * out->motion.pieces * joints;
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    if (changes[k] - before <= NSVCD__SAME_TIME) continue;
    if (changes[k] - before < NSVCD__SLIVER) return 0;
    for (size_t j = 0; j < joints; j++) {
      double v;
      nsvcd__blend_at(&blends[j], before, &end[j], &v);
      middle[j] = last[j] + half * v;
      nsvcd__blend_at(&blends[j], changes[k], &end[j], &v);
    }
    nsvcd__trajectory_add(out, joints, middle, end, changes[k]);
  }
  memcpy(out->points + 2 * out->motion.pieces * joints, to->x, joints * sizeof *to->x);
  return out->motion.pieces > 0;
}
