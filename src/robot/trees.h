// In: a router whose trees have their roots. Out: a path from the start to a goal, through both.
//
// The smaller tree grows, and the other towards it. By looks, edges only seem to be free: those of
// a path can be proven afterwards. What hangs on one that is not free is cut off; the rest stays.
// Source: RRT-Connect (Kuffner and LaValle 2000), with edges that are proven, not sampled; of paths
// by looks, Bohlin and Kavraki (2000).
#pragma once
#include "smooth.h"

// turns after which a tree that has not grown tries along single joints
#define NSVCD__IDLE 100
// radians or metres: seven configurations in eight are drawn no farther than this from the range of
// the start and the goals
#define NSVCD__BESIDE 3.2

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

// A configuration towards which a tree is to grow: any; where it has not grown for long, every
// other time, one of its own nodes with one joint moved. Out of a hole the only free edges are
// often those along one joint.
static void nsvcd__draw(nsvcd__router *r, size_t side, double *out) {
  const size_t joints = r->joints;
  const nsvcd__rrt *t = &r->trees[side];
  if (r->idle[side] >= NSVCD__IDLE && r->turn / 2 % 2) {
    const size_t node = (size_t)(nsvcd__random(&r->random) * (double)t->count);
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

// Are there as many nodes, or tries, or looks, as are allowed?
static int nsvcd__is_at_limit(const nsvcd__router *r) {
  return r->trees[0].count + r->trees[1].count >= r->options.nodes ||
         r->answer.checks >= r->options.tries ||
         (r->is_looking && r->looker.count >= r->looks);
}

// Grows a tree from its node nearest to a configuration: by one edge, or, if `is_greedy`, edge by
// edge. *node: the last new node, or the nearest one. Returns 1 if that is the configuration.
static int nsvcd__grow(nsvcd__router *r, nsvcd__rrt *t, const double *to, int is_greedy,
                       size_t *node) {
  *node = nsvcd__tree_nearest(t, to);
  for (;;) {
    double next[NSVCD_MAX_JOINTS];
    const double *from = nsvcd__node_at(t, *node);
    const double length = nsvcd__edge_length(r, from, to);
    const int ends = length <= r->options.edge;
    if (!(length > 0)) return 1;
    for (size_t j = 0; j < r->joints; j++)
      next[j] = ends ? to[j] : from[j] + r->options.edge / length * (to[j] - from[j]);
    if (!nsvcd__ask_edge(r, from, next) || nsvcd__is_at_limit(r)) return 0;
    *node = nsvcd__tree_add(t, next, *node);
    if (ends || !is_greedy) return ends;
  }
}

// Writes the path through the two nodes where the trees have met, the same configuration.
static void nsvcd__take_path(nsvcd__router *r) {
  const size_t bytes = r->joints * sizeof(double);
  const size_t from_start = r->met[0];
  const size_t from_goal = r->met[1];
  const nsvcd__rrt *start = &r->trees[0];
  const nsvcd__rrt *goal = &r->trees[1];
  size_t count = 1;
  for (size_t n = from_start; start->parents[n] != n; n = start->parents[n]) count++;
  r->corners = count;
  for (size_t n = from_start; count-- > 0; n = start->parents[n])
    memcpy(nsvcd__corner_at(r, count), nsvcd__node_at(start, n), bytes);
  size_t n = from_goal;
  while (goal->parents[n] != n) {
    n = goal->parents[n];
    memcpy(nsvcd__corner_at(r, r->corners++), nsvcd__node_at(goal, n), bytes);
  }
  r->answer.goal = r->goals[n];
}

// Tries an edge from a node of the first tree to one of the second. Returns 1 if it is free: then
// the path is found.
static int nsvcd__join(nsvcd__router *r, size_t from_start, size_t from_goal) {
  const double *to = nsvcd__node_at(&r->trees[1], from_goal);
  if (!nsvcd__ask_edge(r, nsvcd__node_at(&r->trees[0], from_start), to)) return 0;
  r->met[0] = nsvcd__tree_add(&r->trees[0], to, from_start);
  r->met[1] = from_goal;
  return 1;
}

// The trees take what is free of the caller's guess, from both ends. Returns 1 if that is a path.
static int nsvcd__take_guess(nsvcd__router *r) {
  const nsvcd_route_problem *p = &r->problem;
  size_t first = 0;
  size_t last = p->guess_count;
  size_t nodes[2] = {0, 0};
  // which goal it leads to
  if (last > 0)
    nodes[1] = nsvcd__tree_nearest(&r->trees[1], p->guess + (last - 1) * r->joints);
  for (int side = 0; side < 2; side++) {
    nsvcd__rrt *t = &r->trees[side];
    while (first < last) {
      const double *to = p->guess + (side ? last - 1 : first) * r->joints;
      if (!nsvcd__ask_edge(r, nsvcd__node_at(t, nodes[side]), to)) break;
      nodes[side] = nsvcd__tree_add(t, to, nodes[side]);
      first += side == 0;
      last -= side == 1;
    }
  }
  return first == last && nsvcd__join(r, nodes[0], nodes[1]);
}

// Grows the trees until they meet, after the guess and the straight lines. Returns 0 at a limit.
static int nsvcd__seek(nsvcd__router *r) {
  if (r->turn == 0) {
    r->turn = 2;
    if (nsvcd__take_guess(r)) return 1;
    // straight lines to the goals
    const size_t roots = r->trees[1].count;
    for (size_t g = 0; g < roots && g < r->problem.goal_count && !r->is_stopped; g++)
      if (nsvcd__join(r, 0, g)) return 1;
  }
  while (!r->is_stopped && r->moving_count > 0) {
    const size_t side = r->trees[1].count < r->trees[0].count;
    r->turn++;
    nsvcd__rrt *grown = &r->trees[side];
    double drawn[NSVCD_MAX_JOINTS];
    nsvcd__draw(r, side, drawn);
    nsvcd__follow(r->scene, 1, drawn);
    const size_t before = grown->count;
    (void)nsvcd__grow(r, grown, drawn, 0, &r->met[side]);
    if (nsvcd__is_at_limit(r)) return 0;
    r->idle[side] = grown->count == before ? r->idle[side] + 1 : 0;
    if (grown->count == before) continue;
    const double *to = nsvcd__node_at(grown, r->met[side]);
    if (nsvcd__grow(r, &r->trees[1 - side], to, 1, &r->met[1 - side])) return 1;
  }
  return 0;
}

// ---- paths by looks

// Proves the edges from a root to a node, until one is not free: that is cut off.
static int nsvcd__prove_branch(nsvcd__router *r, nsvcd__rrt *t, size_t node) {
  for (;;) {
    size_t next = t->count;
    for (size_t n = node; t->parents[n] != n; n = t->parents[n])
      if (t->edges[n] != NSVCD__EDGE_PROVEN) next = n;
    if (next == t->count) return 1;
    const double *from = nsvcd__node_at(t, t->parents[next]);
    if (!nsvcd__ask_edge(r, from, nsvcd__node_at(t, next))) {
      if (!r->is_stopped) nsvcd__tree_cut(t, next);
      return 0;
    }
    t->edges[next] = NSVCD__EDGE_PROVEN;
  }
}

// Proves the path where the trees have met; where it is not free, they are apart again.
static int nsvcd__prove_path(nsvcd__router *r) {
  const int was = r->is_looking;
  r->is_looking = 0;
  const int to_start = nsvcd__prove_branch(r, &r->trees[0], r->met[0]);
  const int to_goal = nsvcd__prove_branch(r, &r->trees[1], r->met[1]);
  r->is_looking = was;
  return to_start && to_goal;
}
