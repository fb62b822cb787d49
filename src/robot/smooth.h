// In: a path, a polyline that is proven. Out: a motion along it, timed, and then smooth.
//
// At first each edge begins and ends at rest. Then, again and again, two times are drawn: the
// motion between them is replaced by a blend, if that is quicker and proven. Every other time,
// where it still rests, they are drawn about a rest.
// Source: Hauser and Ng-Thow-Hing (2010).
#pragma once
#include "../interface/routes.h"
#include "blends.h"
#include "looks.h"
#include "rrt.h"

// of a motion, at most
#define NSVCD__MOST_PIECES 2048
// seconds: half of the widest window about a rest; how often it may be halved
#define NSVCD__HALF_WINDOW 0.8
#define NSVCD__WINDOWS 6
// of the duration without obstacles: no more can be won
#define NSVCD__FAST_ENOUGH 1.001
// what a blend must win, to be worth its proof: a fraction of its own time, and, unless a rest goes
// with it, one of what the motion takes longer than without obstacles
#define NSVCD__LEAST_GAIN 1e-4
#define NSVCD__WORTHY_GAIN 0.02
// metres that the search adds to the clearance, so that the proof of the whole succeeds
#define NSVCD__SPARE 1e-4f
// check_options.finest and .work of the search
#define NSVCD__SEARCH_FINEST 5e-4f
#define NSVCD__SEARCH_WORK 1000

typedef struct nsvcd__router {
  nsvcd_checker *checker;
  const nsvcd_scene *scene;
  size_t joints;
  nsvcd_route_problem problem;
  nsvcd_route_options options;
  nsvcd_check_options check;
  uint64_t random;
  // motions are looked at, not proven; at most so many
  int is_looking;
  size_t looks;
  nsvcd__looker looker;
  // an error, which stops the search
  nsvcd_result result;
  int is_stopped;
  // turns that the trees have had; since each has grown
  size_t turn, idle[2];
  // from the start, from the goals
  nsvcd__rrt trees[2];
  // (F): the range of their roots
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  // joints that may move
  size_t moving[NSVCD_MAX_JOINTS], moving_count;
  // (G): of each root of trees[1], its goal; how many roots that has
  size_t *goals;
  size_t root_count;
  // the nodes where the trees have met
  size_t met[2];
  // (nodes of both trees + shortcuts, F): corners
  double *path;
  size_t corners;
  // (NSVCD__MOST_WAY, F)
  double *way;
  nsvcd__trajectory trajectory, other, blend;
  nsvcd_route_answer answer;
} nsvcd__router;

static double *nsvcd__corner_at(const nsvcd__router *r, size_t k) {
  return r->path + k * r->joints;
}

static double nsvcd__edge_length(const nsvcd__router *r, const double *from,
                                 const double *to) {
  return sqrt(nsvcd__distance2(from, to, r->joints));
}

// ---- proofs

// Is a motion proven free, and within the limits? answer.check says what is wrong.
static int nsvcd__prove_by(nsvcd__router *r, const nsvcd_joint_motion *motion,
                           const nsvcd_check_options *o) {
  r->answer.checks++;
  r->result = nsvcd_check(r->checker, motion, o, &r->answer.check);
  const int is_free = !r->result && nsvcd__proves_free(&r->answer.check);
  r->answer.proven += (size_t)is_free;
  if (r->result || (!is_free && o->stop && o->stop(o->user))) r->is_stopped = 1;
  return is_free;
}

// Do the axes of all cones stay in them? Else answer.check says which one does not.
static int nsvcd__motion_keeps_cones(nsvcd__router *r, const nsvcd_joint_motion *m) {
  nsvcd_check_answer *answer = &r->answer.check;
  const double start = nsvcd__piece_start(m, 0);
  const double end = nsvcd__piece_start(m, m->pieces);
  const int keeps = nsvcd__keeps_cones(r->checker, m, start, end, &r->check, answer);
  if (!keeps && answer->why == NSVCD_WHY_WORK) r->is_stopped = 1;
  return keeps;
}

// Does a motion seem free, and is it within the limits and the cones?
static int nsvcd__look_along(nsvcd__router *r, const nsvcd_joint_motion *motion) {
  const nsvcd_check_options *o = &r->check;
  if (o->stop && o->stop(o->user)) r->is_stopped = 1;
  // between two configurations within them, edges are
  for (size_t p = 0; motion->degree > 1 && p < motion->pieces; p++)
    if (nsvcd__joint_outside(r->scene, motion, p) != NSVCD_NONE) return 0;
  return !r->is_stopped && nsvcd__motion_keeps_cones(r, motion) &&
         nsvcd__seems_free(&r->looker, motion);
}

// Is a motion free, by a look or by a proof with the search's own options? Once the search is
// stopped, nothing is.
static int nsvcd__ask_motion(nsvcd__router *r, const nsvcd_joint_motion *motion) {
  if (!r->is_stopped && r->problem.stop && r->problem.stop(r->problem.user)) r->is_stopped = 1;
  if (r->is_looking) return nsvcd__look_along(r, motion);
  return !r->is_stopped && nsvcd__prove_by(r, motion, &r->check);
}

// Writes an edge. points: room for two configurations.
static nsvcd_joint_motion nsvcd__edge_motion(const nsvcd__router *r, const double *from,
                                             const double *to, double *points) {
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  memcpy(points, from, r->joints * sizeof *points);
  memcpy(points + r->joints, to, r->joints * sizeof *points);
  return motion;
}

// Of an edge that is not free, answer.check.cone says whether it leaves a cone.
static int nsvcd__ask_edge(nsvcd__router *r, const double *from, const double *to) {
  double points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = nsvcd__edge_motion(r, from, to, points);
  return nsvcd__ask_motion(r, &motion);
}

// ---- from rest to rest

// Adds pieces along an edge: speeds up, goes on, slows down, all joints in proportion.
static void nsvcd__add_edge(nsvcd__router *r, const double *from, const double *to) {
  nsvcd__trajectory *t = &r->trajectory;
  // of the fraction of the edge
  double speed = HUGE_VAL;
  double most = HUGE_VAL;
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double d = fabs(to[j] - from[j]);
    if (!(d > 0)) continue;
    speed = nsvcd__min(speed, NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint) / d);
    most = nsvcd__min(most, NSVCD__BLEND_FRACTION * nsvcd__acceleration_of(joint) / d);
  }
  if (!(speed < HUGE_VAL)) return;
  const double up = nsvcd__min(speed / most, sqrt(1 / most));
  const double fast = most * up;
  const double even = (1 - fast * up) / fast;
  const int is_even = even > NSVCD__SLIVER;
  // fractions where pieces end, and how long they take
  const double first = is_even ? 0.5 * fast * up : 0.5;
  const double ends[3] = {first, is_even ? 1 - first : 0.5, 1};
  const double middles[3] = {0, 0.5, 1};
  const double lasts[3] = {is_even ? up : 1 / fast, even, is_even ? up : 1 / fast};
  for (size_t n = 0; n < 3; n += is_even ? 1 : 2) {
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < r->joints; j++) {
      middle[j] = from[j] + middles[n] * (to[j] - from[j]);
      end[j] = n == 2 ? to[j] : from[j] + ends[n] * (to[j] - from[j]);
    }
    const double time = nsvcd__trajectory_end(t) + lasts[n];
    nsvcd__trajectory_add(t, r->joints, middle, end, time);
  }
}

// A motion along the path, with a rest at each corner. Returns 0 where there are too many. A path
// of one corner becomes a motion of no pieces.
static int nsvcd__trajectory_along(nsvcd__router *r) {
  if (3 * r->corners > NSVCD__MOST_PIECES) return 0;
  nsvcd__trajectory_begin(&r->trajectory, r->joints, r->path);
  for (size_t k = 0; k + 1 < r->corners; k++)
    nsvcd__add_edge(r, nsvcd__corner_at(r, k), nsvcd__corner_at(r, k + 1));
  return 1;
}

// Is the motion at rest where a piece begins?
static int nsvcd__rests_at(const nsvcd__trajectory *t, size_t joints, size_t piece) {
  const double *at = t->points + 2 * piece * joints;
  for (size_t j = 0; j < joints; j++) {
    if (fabs(at[j + joints] - at[j]) > 1e-12 * (1 + fabs(at[j]))) return 0;
  }
  return 1;
}

// ---- smooth

// Adds a trajectory from time t0 to t1 to another one. Returns 0 where a sliver would be left, or
// there is no room.
static int nsvcd__trajectory_append(const nsvcd__trajectory *t, size_t joints, double t0,
                                    double t1, nsvcd__trajectory *out) {
  const nsvcd_joint_motion *m = &t->motion;
  for (size_t p = nsvcd__piece_at(m, t0); p < m->pieces && t->times[p] < t1; p++) {
    const double from = nsvcd__max(t0, t->times[p]);
    const double to = nsvcd__min(t1, t->times[p + 1]);
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    if (to - from <= NSVCD__SAME_TIME) continue;
    if (to - from < NSVCD__SLIVER || out->motion.pieces == NSVCD__MOST_PIECES) return 0;
    for (size_t j = 0; j < joints; j++) {
      double points[NSVCD_MAX_DEGREE + 1];
      nsvcd__joint_points(m, p, joints, j, points);
      nsvcd__cut_curve(points, 2, nsvcd__fraction_at(m, p, from),
                       nsvcd__fraction_at(m, p, to));
      middle[j] = points[1];
      end[j] = points[2];
    }
    const double time = nsvcd__trajectory_end(out) + (to - from);
    nsvcd__trajectory_add(out, joints, middle, end, time);
  }
  return 1;
}

// Replaces the trajectory from time t0 to t1 by a blend, if that is quicker by `gain` and proven.
static void nsvcd__smooth_once(nsvcd__router *r, double t0, double t1, double gain) {
  const size_t joints = r->joints;
  const nsvcd__trajectory *t = &r->trajectory;
  nsvcd__trajectory *blend = &r->blend;
  nsvcd__trajectory *out = &r->other;
  nsvcd__state from, to;
  nsvcd__joints_at_time(&t->motion, joints, t0, from.x, from.v);
  nsvcd__joints_at_time(&t->motion, joints, t1, to.x, to.v);
  if (!nsvcd__blend_write(r->scene, &from, &to, t1 - t0 - gain, blend)) return;
  nsvcd__trajectory_begin(out, joints, t->points);
  if (!nsvcd__trajectory_append(t, joints, 0, t0, out)) return;
  if (!nsvcd__trajectory_append(blend, joints, 0, nsvcd__trajectory_end(blend), out)) return;
  if (!nsvcd__trajectory_append(t, joints, t1, nsvcd__trajectory_end(t), out)) return;
  if (!nsvcd__ask_motion(r, &blend->motion)) return;
  const nsvcd__trajectory was = r->trajectory;
  r->trajectory = *out;
  *out = was;
}

static void nsvcd__smooth(nsvcd__router *r) {
  for (size_t n = 0; n < r->options.smoothings && !r->is_stopped; n++) {
    const nsvcd__trajectory *t = &r->trajectory;
    const double end = nsvcd__trajectory_end(t);
    if (end <= NSVCD__FAST_ENOUGH * r->answer.unhindered) return;
    double t0 = end * nsvcd__random(&r->random);
    double t1 = end * nsvcd__random(&r->random);
    size_t rests = 0;
    double rest = 0;
    for (size_t p = 1; p < t->motion.pieces && n % 2; p++) {
      // each as likely as the others
      if (!nsvcd__rests_at(t, r->joints, p)) continue;
      if (nsvcd__random(&r->random) * (double)++rests <= 1) rest = t->times[p];
    }
    if (rests > 0) {
      const size_t halvings = (size_t)(NSVCD__WINDOWS * nsvcd__random(&r->random));
      const double window = NSVCD__HALF_WINDOW / (double)(1 << halvings);
      t0 = nsvcd__max(0, rest - window);
      t1 = nsvcd__min(end, rest + window);
    }
    const double least = NSVCD__LEAST_GAIN * fabs(t1 - t0);
    const double worthy = NSVCD__WORTHY_GAIN * (end - r->answer.unhindered);
    const double gain = rests ? least : nsvcd__max(least, worthy);
    nsvcd__smooth_once(r, nsvcd__min(t0, t1), nsvcd__max(t0, t1), gain);
  }
}
