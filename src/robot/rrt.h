// In: configurations. Out: a tree of them, and the one that is nearest to another.
//
// Distances are Euclidean, radians and metres alike. A k-d tree that grows: a leaf of more points
// than it may hold is cut half way along the joint in which they are widest apart.
#pragma once
#include "../ground/random.h"
#include "path.h"

#define NSVCD__LEAF 8

typedef struct nsvcd__cell {
  // where it is cut, or of a leaf: nothing
  double at;
  // by which joint; NSVCD_MAX_JOINTS: a leaf
  uint32_t joint;
  // the two halves, one after another; of a leaf: a node and, by `next`, the others, and how many
  uint32_t first, count;
} nsvcd__cell;

typedef struct nsvcd__rrt {
  size_t joints, count, cell_count;
  double *points;      // (nodes, F)
  uint32_t *parents;   // (nodes): of a root, itself
  uint32_t *next;      // (nodes): in a leaf
  nsvcd__cell *cells;  // (2 nodes)
} nsvcd__rrt;

static double nsvcd__distance2(const double *a, const double *b, size_t joints) {
  double sum = 0;
  for (size_t j = 0; j < joints; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

// Cuts a leaf, unless all its points are the same.
static void nsvcd__leaf_cut(nsvcd__rrt *t, size_t index) {
  nsvcd__cell *cell = &t->cells[index];
  size_t widest = 0;
  double width = 0;
  double middle = 0;
  for (size_t j = 0; j < t->joints; j++) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      low = nsvcd__min(low, t->points[node * t->joints + j]);
      high = nsvcd__max(high, t->points[node * t->joints + j]);
    }
    if (!(high - low > width)) continue;
    widest = j;
    width = high - low;
    middle = 0.5 * (low + high);
  }
  if (!(width > 0)) return;
  nsvcd__cell *halves = &t->cells[t->cell_count];
  t->cell_count += 2;
  for (size_t k = 0; k < 2; k++) {
    halves[k].joint = NSVCD_MAX_JOINTS;
    halves[k].count = 0;
  }
  uint32_t node = cell->first;
  for (uint32_t n = 0; n < cell->count; n++) {
    const uint32_t following = t->next[node];
    nsvcd__cell *half = &halves[t->points[node * t->joints + widest] > middle];
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
  memcpy(&t->points[node * t->joints], at, t->joints * sizeof *at);
  t->parents[node] = (uint32_t)parent;
  if (t->cell_count == 0) {
    t->cell_count = 1;
    t->cells[0].joint = NSVCD_MAX_JOINTS;
    t->cells[0].count = 0;
  }
  while (t->cells[index].joint < NSVCD_MAX_JOINTS)
    index = t->cells[index].first + (at[t->cells[index].joint] > t->cells[index].at);
  t->next[node] = t->cells[index].first;
  t->cells[index].first = (uint32_t)node;
  if (++t->cells[index].count > NSVCD__LEAF) nsvcd__leaf_cut(t, index);
  return node;
}

// Looks in a cell, which is `off` from the point, joint by joint, for what is nearer than *best.
static void nsvcd__nearest_in(const nsvcd__rrt *t, size_t index, const double *at, double *off,
                              double off2, size_t *nearest, double *best) {
  const nsvcd__cell *cell = &t->cells[index];
  if (!(off2 < *best)) return;
  if (cell->joint == NSVCD_MAX_JOINTS) {
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      const double distance = nsvcd__distance2(&t->points[node * t->joints], at, t->joints);
      if (!(distance < *best)) continue;
      *best = distance;
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
