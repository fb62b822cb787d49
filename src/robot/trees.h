// In: a router whose trees have their roots. Out: a path from the start to a goal, through both.
//
// The smaller tree grows, and the other towards it. By looks, edges only seem to be free: those of
// a path can be proven afterwards. What hangs on one that is not free is cut off; the rest stays,
// and edges from where it began are proven at once from then on.
// Source: RRT-Connect (Kuffner and LaValle 2000), with edges that are proven, not sampled; of paths
// by looks, Bohlin and Kavraki (2000).
#pragma once
#include "grow.h"

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
    if (nsvcd__into_cones(r->checker, r->problem.held, NSVCD__GROW_CONE, drawn))
      (void)nsvcd__grow(r, grown, drawn, 0, &r->met[side]);
    else
      nsvcd__count_refused(r);
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
      if (!(t->marks[n] & NSVCD__NODE_PROVEN)) next = n;
    if (next == t->count) return 1;
    const double *from = nsvcd__node_at(t, t->parents[next]);
    if (!nsvcd__ask_edge(r, from, nsvcd__node_at(t, next))) {
      if (r->is_stopped) return 0;
      t->marks[t->parents[next]] |= NSVCD__NODE_DOUBTED;
      r->idle[t == &r->trees[1]] = NSVCD__IDLE;
      nsvcd__tree_cut(t, next);
      return 0;
    }
    t->marks[next] |= NSVCD__NODE_PROVEN;
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
