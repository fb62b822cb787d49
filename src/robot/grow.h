// In: a tree of a route, and where it is to grow. Out: new nodes, by edges that are free, in the
// scene's cones.
//
// Where there are cones, a configuration that is drawn is moved into them, and a tree goes on in
// steps, each moved into them anew: as far as the straight edge to it stays in them, and as long as
// that leads nearer.
// Source: CBiRRT (Berenson et al. 2009). Difference: an edge is proven to stay in the cones.
#pragma once
#include "smooth.h"

// turns after which a tree that has not grown tries along single joints
#define NSVCD__IDLE 100
// radians or metres: seven configurations in eight are drawn no farther than this from the range of
// the start and the goals
#define NSVCD__BESIDE 3.2
// the share of a cone's angle that configurations are moved to; how often a step may be halved; and
// the least share of a step by which it leads nearer
#define NSVCD__GROW_CONE 0.6
#define NSVCD__GROW_HALVINGS 6
#define NSVCD__GROW_NEARER 0.25
// looks that a proof takes as long as, about
#define NSVCD__PROOF_LOOKS 16
// corners of a way that makes a path shorter, at most
#define NSVCD__MOST_WAY 16

// A value of a joint in its limits, near the start and the goals or anywhere.
static double nsvcd__draw_joint(nsvcd__router *r, size_t j, int is_wide) {
  const nsvcd_joint *joint = &r->scene->joints[j];
  double low = r->low[j] - NSVCD__BESIDE;
  double high = r->high[j] + NSVCD__BESIDE;
  if (joint->kind != NSVCD_JOINT_CONTINUOUS) {
    low = is_wide ? joint->low : nsvcd__max(low, joint->low);
    high = is_wide ? joint->high : nsvcd__min(high, joint->high);
  }
  return low + (high - low) * nsvcd__random(&r->random);
}

// A configuration towards which a tree may grow: any; where it has not grown for long, every
// other time, one of its own nodes with one joint moved. Out of a hole the only free edges are
// often those along one joint.
static void nsvcd__draw(nsvcd__router *r, size_t side, double *out) {
  const size_t joints = r->joints;
  const nsvcd__rrt *t = &r->trees[side];
  if (r->idle[side] >= NSVCD__IDLE && r->turn / 2 % 2) {
    size_t node = (size_t)(nsvcd__random(&r->random) * (double)t->count);
    while (t->marks[node] & NSVCD__NODE_CUT) node = t->parents[node];
    const size_t joint =
        r->moving[(size_t)(nsvcd__random(&r->random) * (double)r->moving_count)];
    memcpy(out, nsvcd__node_at(t, node), joints * sizeof *out);
    out[joint] = nsvcd__draw_joint(r, joint, 1);
    return;
  }
  const int is_wide = nsvcd__random(&r->random) < 0.125;
  // what is held stays where all roots have it
  memcpy(out, r->low, joints * sizeof *out);
  for (size_t k = 0; k < r->moving_count; k++)
    out[r->moving[k]] = nsvcd__draw_joint(r, r->moving[k], is_wide);
}

// Looks, and proofs as so many.
static size_t nsvcd__spent(const nsvcd__router *r) {
  return r->looker.count + NSVCD__PROOF_LOOKS * r->answer.checks;
}

// Are there as many nodes, or tries, or looks, as are allowed?
static int nsvcd__is_at_limit(const nsvcd__router *r) {
  return r->trees[0].count + r->trees[1].count >= r->options.nodes ||
         r->answer.checks >= r->options.tries ||
         (r->is_looking && nsvcd__spent(r) >= r->looks);
}

// A motion that the cones refuse is asked about, too: else a search might not end.
static void nsvcd__count_refused(nsvcd__router *r) {
  ++*(r->is_looking ? &r->looker.count : &r->answer.checks);
  if (r->problem.stop && r->problem.stop(r->problem.user)) r->is_stopped = 1;
}

// One edge on the way from a configuration to another: no longer than options.edge, in the cones,
// free. Returns 0 if there is none, 2 if it ends there, else 1.
static int nsvcd__step_towards(nsvcd__router *r, const double *from, const double *to,
                               double *next) {
  const double length = nsvcd__edge_length(r, from, to);
  double step = nsvcd__min(length, r->options.edge);
  const size_t halvings = r->scene->cone_count ? NSVCD__GROW_HALVINGS : 0;
  for (size_t n = 0; n <= halvings; n++, step *= 0.5) {
    const int ends = step >= length;
    for (size_t j = 0; j < r->joints; j++)
      next[j] = ends ? to[j] : from[j] + step / length * (to[j] - from[j]);
    if (halvings > 0 && !ends) {
      if (!nsvcd__into_cones(r->checker, r->problem.held, NSVCD__GROW_CONE, next)) continue;
      const double left = nsvcd__edge_length(r, next, to);
      if (!(left <= length - NSVCD__GROW_NEARER * step)) continue;
    }
    if (nsvcd__ask_edge(r, from, next)) return 1 + ends;
    if (r->answer.check.cone == NSVCD_NONE) return 0;
  }
  nsvcd__count_refused(r);
  return 0;
}

// Grows a tree from its node nearest to a configuration: by one edge, or, if `is_greedy`, edge by
// edge. *node: the last new node, or the nearest one. Returns 1 if that is the configuration.
static int nsvcd__grow(nsvcd__router *r, nsvcd__rrt *t, const double *to, int is_greedy,
                       size_t *node) {
  *node = nsvcd__tree_nearest(t, to);
  for (;;) {
    double next[NSVCD_MAX_JOINTS];
    const double *from = nsvcd__node_at(t, *node);
    if (!(nsvcd__distance2(from, to, r->joints) > 0)) return 1;
    const int is_doubted = t->marks[*node] & NSVCD__NODE_DOUBTED;
    const int was = r->is_looking;
    if (is_doubted) r->is_looking = 0;
    const int ends = nsvcd__step_towards(r, from, to, next);
    r->is_looking = was;
    if (!ends || nsvcd__is_at_limit(r)) return 0;
    *node = nsvcd__tree_add(t, next, *node);
    if (is_doubted) t->marks[*node] |= NSVCD__NODE_PROVEN;
    if (ends == 2 || !is_greedy) return ends == 2;
  }
}

// A way between two configurations: an edge, or, where there are cones, some that are no longer
// than `longest` together. corners: (NSVCD__MOST_WAY, F), both ends among them. Returns how many; 0
// if none is found.
static size_t nsvcd__way_between(nsvcd__router *r, const double *from, const double *to,
                                 double longest, double *corners) {
  const size_t bytes = r->joints * sizeof *corners;
  double length = 0;
  memcpy(corners, from, bytes);
  memcpy(corners + r->joints, to, bytes);
  if (nsvcd__ask_edge(r, from, to)) return 2;
  if (r->answer.check.cone == NSVCD_NONE) return 0;
  for (size_t n = 1; n < NSVCD__MOST_WAY; n++) {
    const double *last = corners + (n - 1) * r->joints;
    double *next = corners + n * r->joints;
    const int ends = nsvcd__step_towards(r, last, to, next);
    length += nsvcd__edge_length(r, last, next);
    if (!ends || length > longest) return 0;
    if (ends == 2) return n + 1;
  }
  return 0;
}
