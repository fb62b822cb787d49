// In: two nodes, and a interval of time. Out: a plane that separates them all the while, by a
// normal that takes a few bits; or none.
#pragma once
#include "../ground/triangles.h"
#include "law.h"

// What is asked for beyond what numbers say, of all lengths: the checker's, and a little more.
#define NSVCD__CERTIFIED_MARGIN 1.01e-10
// triangles: of nodes of so many the corners count, of larger ones the boxes
#define NSVCD__EXACT 24
#define NSVCD__NORMAL_STEPS 12    // of Gilbert's iteration
#define NSVCD__NORMAL_ENOUGH 0.8  // of the best distance that a normal may show
// of both lengths: nodes that come as near are opened, not separated
#define NSVCD__NORMAL_GIVE_UP 1e-3

// A time, where both bodies are then, and by how much points leave their chords to the next one.
typedef struct nsvcd__instant {
  double t;
  nsvcd__pose_matrix a, b;
  double lengths;  // of both places, and what they are computed from
  nsvcd_deviation off_a, off_b;
} nsvcd__instant;

// A interval of time: both ends, and all keyframes between.
typedef struct nsvcd__tree_interval {
  const nsvcd__moving_tree *a, *b;
  double clearance;
  nsvcd__instant *instants;  // (capacity)
  size_t count, capacity;
  double t0, t1;
  // half way; its time is -1 before it is needed
  nsvcd__instant middle;
} nsvcd__tree_interval;

// A node of each tree. No point of them is farther from its body's origin than the radii say.
typedef struct nsvcd__nodes {
  nsvcd__node a, b;
  double radius_a, radius_b;
} nsvcd__nodes;

// A direction as it is written: two whole numbers.
typedef struct nsvcd__written_normal {
  nsvcd__d3 along;
  uint32_t x, y;
  int bits;  // of each number: 8, 16 or 24
} nsvcd__written_normal;

static double nsvcd__lengths_at(const nsvcd__pose_matrix *a, const nsvcd__pose_matrix *b) {
  return fabs(a->at.x) + fabs(a->at.y) + fabs(a->at.z) + fabs(b->at.x) + fabs(b->at.y) +
         fabs(b->at.z);
}

static nsvcd__instant nsvcd__instant_at(const nsvcd__moving_tree *a,
                                        const nsvcd__moving_tree *b, double t) {
  nsvcd__instant at;
  memset(&at, 0, sizeof at);
  at.t = t;
  at.a = nsvcd__pose_matrix_at(a, t);
  at.b = nsvcd__pose_matrix_at(b, t);
  at.lengths = a->model.extent + b->model.extent + nsvcd__lengths_at(&at.a, &at.b);
  return at;
}

// Returns 0 where there are more keyframes than there is room for.
static int nsvcd__tree_interval_to(nsvcd__tree_interval *s, double t0, double t1) {
  if (s->count > 0 && !(s->t0 < t0) && !(s->t0 > t0) && !(s->t1 < t1) && !(s->t1 > t1))
    return 1;
  const nsvcd_motion_model *a = &s->a->model;
  const nsvcd_motion_model *b = &s->b->model;
  double t = t0;
  s->t0 = t0;
  s->t1 = t1;
  s->middle.t = -1;
  for (s->count = 0; s->count < s->capacity;) {
    nsvcd__instant *at = &s->instants[s->count++];
    *at = nsvcd__instant_at(s->a, s->b, t);
    if (!(t < t1)) return 1;
    t = nsvcd__min(a->next(a->motion, t), b->next(b->motion, t));
    t = nsvcd__min(t, t1);
    at->off_a = a->deviation(a->motion, at->t, t);
    at->off_b = b->deviation(b->motion, at->t, t);
  }
  return 0;
}

// The instant half way.
static const nsvcd__instant *nsvcd__tree_interval_middle(nsvcd__tree_interval *s) {
  if (s->middle.t < 0) s->middle = nsvcd__instant_at(s->a, s->b, 0.5 * (s->t0 + s->t1));
  return &s->middle;
}

// ---- nodes

// The corner of a node's box, or of its few triangles, that is farthest along a direction in its
// frame.
static nsvcd__d3 nsvcd__farthest(const nsvcd_tree *tree, const nsvcd__node *node,
                                 nsvcd__d3 direction) {
  if (node->count > NSVCD__EXACT) {
    const nsvcd__box *box = &tree->boxes[node->box];
    return nsvcd__d3_of((double)(direction.x > 0 ? box->high.x : box->low.x),
                        (double)(direction.y > 0 ? box->high.y : box->low.y),
                        (double)(direction.z > 0 ? box->high.z : box->low.z));
  }
  const float *corners = tree->corners + 9 * (size_t)node->first;
  double most = -HUGE_VAL;
  size_t farthest = 0;
  for (size_t i = 0; i < 3 * (size_t)node->count; i++) {
    const double along = nsvcd__d3_dot(nsvcd__d3_row(corners, i), direction);
    farthest = along > most ? i : farthest;
    most = along > most ? along : most;
  }
  return nsvcd__d3_row(corners, farthest);
}

static nsvcd__d3 nsvcd__turned_by(const nsvcd__moving_tree *moving,
                                  const nsvcd__pose_matrix *at, nsvcd__d3 x) {
  return nsvcd__d3_scale(nsvcd__dmat3_apply(&at->turn, x), moving->model.scale);
}

// Of all points of two nodes, one of each, the difference a - b that goes least along a direction.
static nsvcd__d3 nsvcd__least_apart(const nsvcd__tree_interval *s, const nsvcd__nodes *nodes,
                                    const nsvcd__instant *at, nsvcd__d3 along) {
  const nsvcd__d3 back = nsvcd__d3_scale(along, -1);
  const nsvcd__d3 way_a = nsvcd__dmat3_apply_transpose(&at->a.turn, back);
  const nsvcd__d3 way_b = nsvcd__dmat3_apply_transpose(&at->b.turn, along);
  const nsvcd__d3 a = nsvcd__farthest(s->a->tree, &nodes->a, way_a);
  const nsvcd__d3 b = nsvcd__farthest(s->b->tree, &nodes->b, way_b);
  const nsvcd__d3 turned =
      nsvcd__d3_sub(nsvcd__turned_by(s->a, &at->a, a), nsvcd__turned_by(s->b, &at->b, b));
  return nsvcd__d3_add(turned, nsvcd__d3_sub(at->a.at, at->b.at));
}

// How far along a direction, in its frame, a node reaches. Three corners at a time: a maximum waits
// for the one before.
static double nsvcd__most_along(const nsvcd_tree *tree, const nsvcd__node *node,
                                nsvcd__d3 direction) {
  if (node->count > NSVCD__EXACT)
    return nsvcd__d3_dot(nsvcd__farthest(tree, node, direction), direction);
  const float *corners = tree->corners + 9 * (size_t)node->first;
  double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < node->count; i++) {
    for (size_t k = 0; k < 3; k++)
      most[k] =
          nsvcd__max(nsvcd__d3_dot(nsvcd__d3_row(corners, 3 * i + k), direction), most[k]);
  }
  return nsvcd__max(most[0], nsvcd__max(most[1], most[2]));
}

// How far that difference goes.
static double nsvcd__gap_along(const nsvcd__tree_interval *s, const nsvcd__nodes *nodes,
                               const nsvcd__instant *at, nsvcd__d3 along) {
  const nsvcd__d3 way_a = nsvcd__dmat3_apply_transpose(&at->a.turn, along);
  const nsvcd__d3 way_b = nsvcd__dmat3_apply_transpose(&at->b.turn, along);
  const nsvcd__d3 back = nsvcd__d3_scale(way_a, -1);
  const double a = s->a->model.scale * nsvcd__most_along(s->a->tree, &nodes->a, back);
  const double b = s->b->model.scale * nsvcd__most_along(s->b->tree, &nodes->b, way_b);
  return nsvcd__d3_dot(along, nsvcd__d3_sub(at->a.at, at->b.at)) - (a + b);
}

static double nsvcd__node_radius(const nsvcd__moving_tree *moving, const nsvcd__node *node) {
  const nsvcd__box *box = &moving->tree->boxes[node->box];
  const nsvcd__f3 corner = nsvcd__f3_max(box->high, nsvcd__f3_scale(box->low, -1));
  return 1.000002 * moving->model.scale * nsvcd__d3_length(nsvcd__d3_widen(corner));
}

// No point of a node is farther from the line through its body's origin along a unit axis.
static double nsvcd__node_aside(const nsvcd__moving_tree *moving, const nsvcd__node *node,
                                nsvcd__d3 axis) {
  const float *corners = moving->tree->corners + 9 * (size_t)node->first;
  double square = 0;
  if (node->count > NSVCD__EXACT) {
    const nsvcd__box *box = &moving->tree->boxes[node->box];
    const nsvcd__d3 low = nsvcd__d3_widen(box->low);
    const nsvcd__d3 high = nsvcd__d3_widen(box->high);
    const nsvcd__d3 half = nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5);
    const nsvcd__d3 a = nsvcd__d3_of(fabs(axis.x), fabs(axis.y), fabs(axis.z));
    const nsvcd__d3 off = nsvcd__d3_cross(nsvcd__d3_mix(low, high, 0.5), axis);
    const double x = fabs(off.x) + half.y * a.z + half.z * a.y;
    const double y = fabs(off.y) + half.z * a.x + half.x * a.z;
    const double z = fabs(off.z) + half.x * a.y + half.y * a.x;
    square = x * x + y * y + z * z;
  }
  for (size_t i = 0; i < 3 * (size_t)node->count && node->count <= NSVCD__EXACT; i++) {
    const nsvcd__d3 off = nsvcd__d3_cross(nsvcd__d3_row(corners, i), axis);
    square = nsvcd__max(square, nsvcd__d3_dot(off, off));
  }
  return 1.000002 * moving->model.scale * sqrt(square);
}

// By how much the points of a node, at r metres at most, leave their chords along a normal.
static double nsvcd__node_leaves(const nsvcd__moving_tree *moving, const nsvcd__node *node,
                                 double r, const nsvcd__pose_matrix *at,
                                 const nsvcd_deviation *off, nsvcd__d3 along) {
  double leaves = nsvcd__d3_length(along) * (off->base + off->per_metre * r);
  if (off->turn > 0) {
    const nsvcd__d3 own = nsvcd__d3_of(off->axis[0], off->axis[1], off->axis[2]);
    const nsvcd__d3 axis = nsvcd__dmat3_apply(&at->turn, own);
    const double across = nsvcd__d3_length(nsvcd__d3_cross(along, axis));
    leaves += off->turn * across * nsvcd__node_aside(moving, node, own);
  }
  return leaves;
}

// Does a plane of this normal part two nodes, at all instants and between them?
static int nsvcd__plane_separates_nodes(const nsvcd__tree_interval *s,
                                        const nsvcd__nodes *nodes, nsvcd__d3 along) {
  const double length = nsvcd__d3_length(along);
  const double ra = nodes->radius_a;
  const double rb = nodes->radius_b;
  double last = HUGE_VAL;
  double last_lengths = 0;
  double leaves = 0;
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__instant *at = &s->instants[i];
    const double lengths = ra + rb + s->clearance + at->lengths;
    const double gap = nsvcd__gap_along(s, nodes, at, along);
    const double margin = NSVCD__CERTIFIED_MARGIN * nsvcd__max(lengths, last_lengths);
    const double most = length * (s->clearance + margin) + leaves;
    if (!(gap > most && last > most)) return 0;
    last = gap;
    last_lengths = lengths;
    leaves = nsvcd__node_leaves(s->a, &nodes->a, ra, &at->a, &at->off_a, along);
    leaves += nsvcd__node_leaves(s->b, &nodes->b, rb, &at->b, &at->off_b, along);
  }
  return 1;
}

// ---- normals

static double nsvcd__signed(double magnitude, double sign) {
  return sign < 0 ? -magnitude : magnitude;
}

// A point of the octahedron |x| + |y| + |z| = half, seen from above, its lower half folded
// outwards.
static nsvcd__written_normal nsvcd__normal_of(nsvcd__d3 along, int bits) {
  const double half = (double)((1 << (bits - 1)) - 1);
  const double sum = fabs(along.x) + fabs(along.y) + fabs(along.z);
  const double x = along.x * (half / sum);
  const double y = along.y * (half / sum);
  const int below = along.z < 0;
  nsvcd__written_normal out;
  out.bits = bits;
  const double u = floor((below ? nsvcd__signed(half - fabs(y), x) : x) + 0.5);
  const double v = floor((below ? nsvcd__signed(half - fabs(x), y) : y) + 0.5);
  const double z = half - fabs(u) - fabs(v);
  out.x = (uint32_t)(u + half);
  out.y = (uint32_t)(v + half);
  out.along.x = z < 0 ? nsvcd__signed(half - fabs(v), u) : u;
  out.along.y = z < 0 ? nsvcd__signed(half - fabs(u), v) : v;
  out.along.z = z;
  return out;
}

// The best direction so far, and how far apart it shows two nodes half way; less than 0: not at
// all.
typedef struct nsvcd__best {
  nsvcd__d3 along;
  double gap;
} nsvcd__best;

// Gilbert's iteration towards the point of a - b that is nearest to the origin.
static nsvcd__best nsvcd__gilbert(const nsvcd__tree_interval *s, const nsvcd__nodes *nodes,
                                  const nsvcd__instant *at, nsvcd__d3 along) {
  nsvcd__best best = {along, -HUGE_VAL};
  nsvcd__d3 v = nsvcd__least_apart(s, nodes, at, along);
  const double size = nsvcd__d3_length(v);
  for (int step = 0; step < NSVCD__NORMAL_STEPS; step++) {
    const double length = nsvcd__d3_length(v);
    if (!(length > NSVCD__NORMAL_GIVE_UP * size)) break;
    const nsvcd__d3 w = nsvcd__least_apart(s, nodes, at, v);
    const double gap = nsvcd__d3_dot(v, w) / length;
    if (gap > best.gap) {
      best.along = v;
      best.gap = gap;
    }
    if (gap - s->clearance > NSVCD__NORMAL_ENOUGH * (length - s->clearance)) break;
    const nsvcd__d3 step_to = nsvcd__d3_sub(w, v);
    const double square = nsvcd__d3_dot(step_to, step_to);
    if (!(square > 0)) break;
    const double fraction = -nsvcd__d3_dot(v, step_to) / square;
    v = nsvcd__d3_fma(nsvcd__max(0, nsvcd__min(fraction, 1)), step_to, v);
  }
  return best;
}

// A leaf's triangle in the world, as seen from the origin of b.
static void nsvcd__leaf_corners(const nsvcd__moving_tree *moving, const nsvcd__node *node,
                                const nsvcd__pose_matrix *at, nsvcd__d3 offset,
                                nsvcd__d3 *corners) {
  const float *x = moving->tree->corners + 9 * (size_t)node->first;
  for (size_t k = 0; k < 3; k++)
    corners[k] = nsvcd__d3_add(nsvcd__turned_by(moving, at, nsvcd__d3_row(x, k)), offset);
}

// Looks for a plane that separates two nodes all the while.
static int nsvcd__find_normal(nsvcd__tree_interval *s, const nsvcd__nodes *nodes,
                              nsvcd__d3 last, nsvcd__written_normal *normal) {
  const nsvcd__instant *at = nsvcd__tree_interval_middle(s);
  nsvcd__best best = {last, 0};
  if (nodes->a.count == 1 && nodes->b.count == 1) {
    nsvcd__d3 a[3], b[3];
    nsvcd__leaf_corners(s->a, &nodes->a, &at->a, nsvcd__d3_sub(at->a.at, at->b.at), a);
    nsvcd__leaf_corners(s->b, &nodes->b, &at->b, nsvcd__d3_of(0, 0, 0), b);
    const nsvcd__nearest nearest = nsvcd__nearest_of(a, b);
    best.along = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    best.gap = sqrt(nearest.square);
  } else {
    best = nsvcd__gilbert(s, nodes, at, last);
  }
  if (!(best.gap > s->clearance)) return 0;
  for (int bits = 8; bits <= 24; bits += 8) {
    *normal = nsvcd__normal_of(best.along, bits);
    if (nsvcd__plane_separates_nodes(s, nodes, normal->along)) return 1;
  }
  return 0;
}
