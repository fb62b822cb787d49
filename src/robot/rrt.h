// In: configurations. Out: a tree of them, and the node that is nearest to another configuration.
//
// Distances are Euclidean, radians and metres alike. The nearest node is found by a k-d tree that
// grows: a leaf with too many nodes is cut half way along the joint in which they are widest apart.
#pragma once
#include "../ground/random.h"
#include "steps.h"

// nodes of a leaf, at most
#define NSVCD__LEAF 8

// A cell of the k-d tree.
typedef struct nsvcd__cell {
  // where it is cut; unused in a leaf
  double at;
  // by which; NSVCD_MAX_JOINTS: a leaf
  uint32_t joint;
  // its halves, one after another; of a leaf: its nodes, by `next`
  uint32_t first, count;
} nsvcd__cell;

// What is known of a node: the edge from its parent is proven; it is not in the tree any more; an
// edge from here that seemed free was not.
enum { NSVCD__NODE_PROVEN = 1, NSVCD__NODE_CUT = 2, NSVCD__NODE_DOUBTED = 4 };

typedef struct nsvcd__rrt {
  size_t joints, count, cell_count;
  // (nodes, F)
  double *points;
  // (nodes): of a root, itself
  uint32_t *parents;
  // (nodes): NSVCD__NODE_*
  uint8_t *marks;
  // (nodes): in a leaf
  uint32_t *next;
  // (2 nodes)
  nsvcd__cell *cells;
} nsvcd__rrt;

static const nsvcd__cell nsvcd__empty_leaf = {0, NSVCD_MAX_JOINTS, 0, 0};

static double *nsvcd__node_at(const nsvcd__rrt *t, size_t node) {
  return t->points + node * t->joints;
}

// Cuts a leaf, unless all its points are the same.
static void nsvcd__cut_leaf(nsvcd__rrt *t, size_t index) {
  nsvcd__cell *cell = &t->cells[index];
  size_t widest = 0;
  double width = 0;
  double middle = 0;
  for (size_t j = 0; j < t->joints; j++) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      low = nsvcd__min(low, nsvcd__node_at(t, node)[j]);
      high = nsvcd__max(high, nsvcd__node_at(t, node)[j]);
    }
    if (!(high - low > width)) continue;
    widest = j;
    width = high - low;
    middle = 0.5 * (low + high);
  }
  if (!(width > 0)) return;
  nsvcd__cell *halves = &t->cells[t->cell_count];
  halves[0] = halves[1] = nsvcd__empty_leaf;
  t->cell_count += 2;
  uint32_t node = cell->first;
  for (uint32_t n = 0; n < cell->count; n++) {
    const uint32_t following = t->next[node];
    nsvcd__cell *half = &halves[nsvcd__node_at(t, node)[widest] > middle];
    t->next[node] = half->first;
    half->first = node;
    half->count++;
    node = following;
  }
  cell->joint = (uint32_t)widest;
  cell->at = middle;
  cell->first = (uint32_t)(halves - t->cells);
}

// parent: t->count of a root. Returns the node.
static size_t nsvcd__tree_add(nsvcd__rrt *t, const double *at, size_t parent) {
  const size_t node = t->count++;
  size_t index = 0;
  memcpy(nsvcd__node_at(t, node), at, t->joints * sizeof *at);
  t->parents[node] = (uint32_t)parent;
  t->marks[node] = 0;
  if (t->cell_count == 0) t->cells[t->cell_count++] = nsvcd__empty_leaf;
  while (t->cells[index].joint < NSVCD_MAX_JOINTS)
    index = t->cells[index].first + (at[t->cells[index].joint] > t->cells[index].at);
  t->next[node] = t->cells[index].first;
  t->cells[index].first = (uint32_t)node;
  if (++t->cells[index].count > NSVCD__LEAF) nsvcd__cut_leaf(t, index);
  return node;
}

// Cuts off a node, and all that hangs on it. A parent comes before its children.
static void nsvcd__tree_cut(nsvcd__rrt *t, size_t node) {
  t->marks[node] |= NSVCD__NODE_CUT;
  for (size_t n = node + 1; n < t->count; n++)
    if (t->marks[t->parents[n]] & NSVCD__NODE_CUT) t->marks[n] |= NSVCD__NODE_CUT;
}

// Looks in a cell for a node nearer than *best, a squared distance. off: from the point to the
// cell, joint by joint, and its square.
static void nsvcd__nearest_in(const nsvcd__rrt *t, size_t index, const double *at, double *off,
                              double off2, size_t *nearest, double *best) {
  const nsvcd__cell *cell = &t->cells[index];
  if (!(off2 < *best)) return;
  if (cell->joint == NSVCD_MAX_JOINTS) {
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      const double distance2 = nsvcd__distance2(nsvcd__node_at(t, node), at, t->joints);
      if (!(distance2 < *best) || t->marks[node] & NSVCD__NODE_CUT) continue;
      *best = distance2;
      *nearest = node;
    }
    return;
  }
  const double side = at[cell->joint] - cell->at;
  const double was = off[cell->joint];
  nsvcd__nearest_in(t, cell->first + (side > 0), at, off, off2, nearest, best);
  off[cell->joint] = side;
  nsvcd__nearest_in(t, cell->first + !(side > 0), at, off, off2 + side * side - was * was,
                    nearest, best);
  off[cell->joint] = was;
}

// The node nearest to a configuration, of a tree that has one.
static size_t nsvcd__tree_nearest(const nsvcd__rrt *t, const double *at) {
  double off[NSVCD_MAX_JOINTS] = {0};
  double best = HUGE_VAL;
  size_t nearest = 0;
  nsvcd__nearest_in(t, 0, at, off, 0, &nearest, &best);
  return nearest;
}
