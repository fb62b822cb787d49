// In: a way, a polyline that is proven. Out: a motion in time along it, then one that is smooth.
//
// Each edge is gone along from rest to rest. Then, again and again, two times are drawn: the motion
// between them is replaced by a blend, if that is quicker and proven. Where it still rests, the two
// times are drawn about that.
// Source: Hauser and Ng-Thow-Hing (2010).
#pragma once
#include "../interface/routes.h"
#include "blends.h"

// of a motion, at most
#define NSVCD__MOST_PIECES 2048
// seconds: half of the windows about a rest, the widest, and how often it may be halved
#define NSVCD__HALF_WINDOW 0.8
#define NSVCD__WINDOWS 6
// of the duration without obstacles: there is nothing to win
#define NSVCD__FAST_ENOUGH 1.001
// what a blend is to win, to be worth its proof: a share of its own time, and, unless a rest goes
// with it, of what the motion takes longer than without obstacles
#define NSVCD__LEAST_GAIN 1e-4
#define NSVCD__WORTHY_GAIN 0.02
// metres that the search stays farther away than asked for, so that the whole is proven anew
#define NSVCD__SPARE 1e-4f
// metres that a part may deviate from its sweeps, at least, in the search
#define NSVCD__SEEK_FINEST 5e-4f
// units that a question of the search may take
#define NSVCD__SEEK_WORK 1000

// A motion of degree 2 that is being made.
typedef struct nsvcd__trajectory {
  double *points;  // (2 NSVCD__MOST_PIECES + 1, F)
  double *times;   // (NSVCD__MOST_PIECES + 1)
  size_t pieces;
} nsvcd__trajectory;

typedef struct nsvcd__router {
  nsvcd_checker *checker;
  const nsvcd_scene *scene;
  size_t joints;
  nsvcd_route_problem problem;
  nsvcd_route_options options;
  nsvcd_check_options check;
  uint64_t random;
  int is_stopped;
  // turns since each tree has grown
  size_t idle[2];
  nsvcd__rrt trees[2];  // from the start, from the goals
  // (F): the range of their roots
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  size_t *goals;  // (G): of those that are free, which; the roots of trees[1]
  double *path;   // (nodes of both trees + shortcuts, F)
  size_t path_count;
  nsvcd__trajectory trajectory, other, blend;
  nsvcd_route_answer answer;
} nsvcd__router;

static nsvcd_joint_motion nsvcd__motion_of(const nsvcd__trajectory *trajectory) {
  const nsvcd_joint_motion out = {trajectory->pieces, 2, trajectory->points,
                                  trajectory->times};
  return out;
}

// Is a motion proven free, and within the limits? answer.check says what is wrong.
static nsvcd_result nsvcd__prove_by(nsvcd__router *r, const nsvcd_joint_motion *motion,
                                    const nsvcd_check_options *options, int *is_free) {
  r->answer.checks++;
  const nsvcd_result result = nsvcd_check(r->checker, motion, options, &r->answer.check);
  *is_free =
      !result && r->answer.check.verdict == NSVCD_FREE && r->answer.check.joint == NSVCD_NONE;
  r->answer.proven += (size_t)*is_free;
  if (!*is_free && options->stop && options->stop(options->user)) r->is_stopped = 1;
  return result;
}

// The same by what the search asks for. What the caller stops is not free.
static nsvcd_result nsvcd__ask_motion(nsvcd__router *r, const nsvcd_joint_motion *motion,
                                      int *is_free) {
  *is_free = 0;
  if (!r->is_stopped && r->problem.stop && r->problem.stop(r->problem.user)) r->is_stopped = 1;
  return r->is_stopped ? NSVCD_OK : nsvcd__prove_by(r, motion, &r->check, is_free);
}

static nsvcd_result nsvcd__prove_edge(nsvcd__router *r, const double *from, const double *to,
                                      int *is_free) {
  double points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  memcpy(points, from, r->joints * sizeof *points);
  memcpy(points + r->joints, to, r->joints * sizeof *points);
  return nsvcd__ask_motion(r, &motion, is_free);
}

// Adds a piece of degree 2 from where the trajectory is; the times rise by `time`.
static void nsvcd__trajectory_add(nsvcd__trajectory *c, size_t joints, const double *middle,
                                  const double *end, double time) {
  double *at = c->points + (2 * c->pieces + 1) * joints;
  memcpy(at, middle, joints * sizeof *at);
  memcpy(at + joints, end, joints * sizeof *at);
  c->times[c->pieces + 1] = c->times[c->pieces] + time;
  c->pieces++;
}

static void nsvcd__trajectory_begin(nsvcd__trajectory *c, size_t joints, const double *at) {
  c->pieces = 0;
  c->times[0] = 0;
  memcpy(c->points, at, joints * sizeof *at);
}

// Goes along the way, with a rest at each corner. Returns 0 where there are too many. A way of one
// place is a rest, of no pieces.
static int nsvcd__trajectory_along(nsvcd__router *r) {
  nsvcd__trajectory *c = &r->trajectory;
  const size_t joints = r->joints;
  if (3 * r->path_count > NSVCD__MOST_PIECES) return 0;
  nsvcd__trajectory_begin(c, joints, r->path);
  for (size_t k = 0; k + 1 < r->path_count; k++) {
    const double *from = r->path + k * joints;
    const double *to = from + joints;
    // of the share of the edge that has been gone along
    double speed = HUGE_VAL;
    double most = HUGE_VAL;
    for (size_t j = 0; j < joints; j++) {
      const nsvcd_joint *joint = &r->scene->joints[j];
      const double d = fabs(to[j] - from[j]);
      if (!(d > 0)) continue;
      speed = nsvcd__min(speed, NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint) / d);
      most = nsvcd__min(most, NSVCD__BLEND_FRACTION * nsvcd__acceleration_of(joint) / d);
    }
    if (!(speed < HUGE_VAL)) continue;
    const double up = nsvcd__min(speed / most, sqrt(1 / most));
    const double fast = most * up;
    const double even = (1 - fast * up) / fast;
    const double changed = 0.5 * fast * up;  // share of the edge
    const int is_even = even > NSVCD__SLIVER;
    // 0, changed, 1 - changed, 1; without an even part, a half
    const double shares[4] = {0, is_even ? changed : 0.5, is_even ? 1 - changed : 0.5, 1};
    const double middles[3] = {0, 0.5, 1};
    const double lasts[3] = {is_even ? up : 1 / fast, even, is_even ? up : 1 / fast};
    for (size_t n = 0; n < 3; n++) {
      double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
      if (n == 1 && !is_even) continue;
      for (size_t j = 0; j < joints; j++) {
        middle[j] = from[j] + middles[n] * (to[j] - from[j]);
        end[j] = n == 2 ? to[j] : from[j] + shares[n + 1] * (to[j] - from[j]);
      }
      nsvcd__trajectory_add(c, joints, middle, end, lasts[n]);
    }
  }
  return 1;
}

// Is the motion at rest where a piece begins?
static int nsvcd__rests_at(const nsvcd__trajectory *c, size_t joints, size_t piece) {
  const double *at = c->points + 2 * piece * joints;
  for (size_t j = 0; j < joints; j++) {
    if (fabs(at[j + joints] - at[j]) > 1e-12 * (1 + fabs(at[j]))) return 0;
  }
  return 1;
}

// Copies the trajectory from time t0 to t1 to the end of another. Returns 0 where a sliver would be
// left, or there is no room.
static int nsvcd__trajectory_copy(const nsvcd__trajectory *c, size_t joints, double t0,
                                  double t1, nsvcd__trajectory *out) {
  const nsvcd_joint_motion motion = nsvcd__motion_of(c);
  for (size_t p = nsvcd__piece_at(&motion, t0); p < c->pieces && c->times[p] < t1; p++) {
    const double from = nsvcd__max(t0, c->times[p]);
    const double to = nsvcd__min(t1, c->times[p + 1]);
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    if (to - from <= NSVCD__SAME_TIME) continue;
    if (to - from < NSVCD__SLIVER || out->pieces == NSVCD__MOST_PIECES) return 0;
    for (size_t j = 0; j < joints; j++) {
      double points[NSVCD_MAX_DEGREE + 1];
      nsvcd__joint_points(&motion, p, joints, j, points);
      nsvcd__cut_curve(points, 2, nsvcd__fraction_at(&motion, p, from),
                       nsvcd__fraction_at(&motion, p, to));
      middle[j] = points[1];
      end[j] = points[2];
    }
    nsvcd__trajectory_add(out, joints, middle, end, to - from);
  }
  return 1;
}

// Replaces the trajectory from time t0 to t1 by a blend, if that is quicker by `gain` and proven.
static nsvcd_result nsvcd__smooth_once(nsvcd__router *r, double t0, double t1, double gain) {
  const size_t joints = r->joints;
  double states[4][NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = nsvcd__motion_of(&r->trajectory);
  const double times[2] = {t0, t1};
  for (size_t n = 0; n < 2; n++) {
    const size_t piece = nsvcd__piece_at(&motion, times[n]);
    nsvcd__joints_at(&motion, joints, piece, nsvcd__fraction_at(&motion, piece, times[n]),
                     states[n], states[n + 2]);
  }
  nsvcd__trajectory *blend = &r->blend;
  blend->pieces =
      nsvcd__blend_write(r->scene, states, t1 - t0 - gain, blend->points, blend->times);
  if (!blend->pieces) return NSVCD_OK;
  // the whole as it would be: what is left of the trajectory, and the blend between
  nsvcd__trajectory *out = &r->other;
  nsvcd__trajectory_begin(out, joints, r->trajectory.points);
  const double end = r->trajectory.times[r->trajectory.pieces];
  if (!nsvcd__trajectory_copy(&r->trajectory, joints, 0, t0, out)) return NSVCD_OK;
  if (out->pieces + blend->pieces > NSVCD__MOST_PIECES) return NSVCD_OK;
  for (size_t p = 0; p < blend->pieces; p++) {
    const double *middle = blend->points + (2 * p + 1) * joints;
    nsvcd__trajectory_add(out, joints, middle, middle + joints,
                          blend->times[p + 1] - blend->times[p]);
  }
  if (!nsvcd__trajectory_copy(&r->trajectory, joints, t1, end, out)) return NSVCD_OK;
  int is_free;
  const nsvcd_joint_motion asked = nsvcd__motion_of(blend);
  const nsvcd_result result = nsvcd__ask_motion(r, &asked, &is_free);
  if (result || !is_free) return result;
  const nsvcd__trajectory was = r->trajectory;
  r->trajectory = r->other;
  r->other = was;
  return NSVCD_OK;
}

static nsvcd_result nsvcd__smooth(nsvcd__router *r) {
  for (size_t n = 0; n < r->options.smoothings && !r->is_stopped; n++) {
    const nsvcd__trajectory *c = &r->trajectory;
    const double end = c->times[c->pieces];
    if (end <= NSVCD__FAST_ENOUGH * r->answer.unhindered) return NSVCD_OK;
    double t0 = end * nsvcd__random(&r->random);
    double t1 = end * nsvcd__random(&r->random);
    size_t rests = 0;
    double rest = 0;
    for (size_t p = 1; p < c->pieces && n % 2; p++) {
      // each as likely as the others
      if (!nsvcd__rests_at(c, r->joints, p)) continue;
      if (nsvcd__random(&r->random) * (double)++rests <= 1) rest = c->times[p];
    }
    if (rests > 0) {
      const double window =
          NSVCD__HALF_WINDOW /
          (double)(1 << (size_t)(NSVCD__WINDOWS * nsvcd__random(&r->random)));
      t0 = nsvcd__max(0, rest - window);
      t1 = nsvcd__min(end, rest + window);
    }
    const double least = NSVCD__LEAST_GAIN * fabs(t1 - t0);
    const double worthy = NSVCD__WORTHY_GAIN * (end - r->answer.unhindered);
    const nsvcd_result result = nsvcd__smooth_once(r, nsvcd__min(t0, t1), nsvcd__max(t0, t1),
                                                   rests ? least : nsvcd__max(least, worthy));
    if (result) return result;
  }
  return NSVCD_OK;
}
