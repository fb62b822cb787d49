// In: two nodes, and an interval of time. Out: a plane that separates them all the while, by a
// normal that takes a few bits; or none.
#pragma once
#include "../ground/triangles.h"
#include "models.h"

// the margin of a separation, as a fraction of all lengths: the checker's, and a little more
#define NSVCD__CERTIFIED_MARGIN 1.01e-10
// nodes of so many triangles are their corners, larger ones their boxes
#define NSVCD__EXACT 24
// of Gilbert's iteration: steps; it ends at this fraction of the best possible distance, and where
// nodes are nearer than that fraction of the first distance
#define NSVCD__GILBERT_STEPS 12
#define NSVCD__GILBERT_ENOUGH 0.8
#define NSVCD__GILBERT_LEAST 1e-3

// Both bodies at a time, and how far points leave their chords to the next instant.
typedef struct nsvcd__instant {
  double t;
  nsvcd__dtransform poses[2];
  // of both positions, and of what they are computed from
  double lengths;
  nsvcd_deviation deviations[2];
} nsvcd__instant;

// An interval of time: instants at both ends, and at all keyframes between.
typedef struct nsvcd__tree_interval {
  // (2)
  const nsvcd__moving *bodies;
  double clearance;
  // (capacity)
  nsvcd__instant *instants;
  size_t count, capacity;
  double t0, t1;
  // half way; its time is -1 before it is needed
  nsvcd__instant middle;
} nsvcd__tree_interval;

// A node of each tree, and bounds of the distances of their points from their bodies' origins.
typedef struct nsvcd__node_pair {
  nsvcd__node nodes[2];
  double radii[2];
} nsvcd__node_pair;

static int nsvcd__are_leaves(const nsvcd__node_pair *pair) {
  return pair->nodes[0].count == 1 && pair->nodes[1].count == 1;
}

// A direction as it is written: two whole numbers.
typedef struct nsvcd__coded_normal {
  nsvcd__d3 along;
  uint32_t x, y;
  // of each number: 8, 16 or 24
  int bits;
} nsvcd__coded_normal;

static double nsvcd__lengths_at(const nsvcd__dtransform *a, const nsvcd__dtransform *b) {
  return fabs(a->position.x) + fabs(a->position.y) + fabs(a->position.z) +
         fabs(b->position.x) + fabs(b->position.y) + fabs(b->position.z);
}

static nsvcd__instant nsvcd__instant_at(const nsvcd__moving *bodies, double t) {
  nsvcd__instant at;
  memset(&at, 0, sizeof at);
  at.t = t;
  for (size_t n = 0; n < 2; n++) {
    at.poses[n] = nsvcd__transform_at(&bodies[n], t);
    at.lengths += bodies[n].model.extent;
  }
  at.lengths += nsvcd__lengths_at(&at.poses[0], &at.poses[1]);
  return at;
}

// Sets the interval. Returns 0 where there is no room for its keyframes.
static int nsvcd__tree_interval_to(nsvcd__tree_interval *s, double t0, double t1) {
  if (s->count > 0 && !(s->t0 < t0) && !(s->t0 > t0) && !(s->t1 < t1) && !(s->t1 > t1))
    return 1;
  double t = t0;
  s->t0 = t0;
  s->t1 = t1;
  s->middle.t = -1;
  for (s->count = 0; s->count < s->capacity;) {
    nsvcd__instant *at = &s->instants[s->count++];
    double next = t1;
    *at = nsvcd__instant_at(s->bodies, t);
    if (!(t < t1)) return 1;
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_motion_model *m = &s->bodies[n].model;
      next = nsvcd__min(m->next(m->motion, t), next);
    }
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_motion_model *m = &s->bodies[n].model;
      at->deviations[n] = m->deviation(m->motion, t, next);
    }
    t = next;
  }
  return 0;
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

static nsvcd__d3 nsvcd__turned_by(const nsvcd__moving *moving, const nsvcd__dtransform *at,
                                  nsvcd__d3 x) {
  return nsvcd__d3_scale(nsvcd__dmat3_apply(&at->rotation, x), moving->model.scale);
}

// A direction of the world in a body's frame; for a, reversed: from each node to the other.
static nsvcd__d3 nsvcd__inward(const nsvcd__instant *at, size_t n, nsvcd__d3 along) {
  const nsvcd__d3 in = nsvcd__dmat3_apply_transpose(&at->poses[n].rotation, along);
  return nsvcd__d3_scale(in, n ? 1 : -1);
}

static nsvcd__d3 nsvcd__offset_at(const nsvcd__instant *at) {
  return nsvcd__d3_sub(at->poses[0].position, at->poses[1].position);
}

// Of all points a and b of two nodes, the difference a - b that is least along a direction.
static nsvcd__d3 nsvcd__least_apart(const nsvcd__tree_interval *s,
                                    const nsvcd__node_pair *pair, const nsvcd__instant *at,
                                    nsvcd__d3 along) {
  nsvcd__d3 ends[2];
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__moving *body = &s->bodies[n];
    const nsvcd__d3 in = nsvcd__inward(at, n, along);
    const nsvcd__d3 x = nsvcd__farthest(body->tree, &pair->nodes[n], in);
    ends[n] = nsvcd__turned_by(body, &at->poses[n], x);
  }
  return nsvcd__d3_add(nsvcd__d3_sub(ends[0], ends[1]), nsvcd__offset_at(at));
}

// The extent of a node along a direction in its frame. Three maxima side by side: each waits for
// the one before.
static double nsvcd__extent_along(const nsvcd_tree *tree, const nsvcd__node *node,
                                  nsvcd__d3 direction) {
  if (node->count > NSVCD__EXACT)
    return nsvcd__d3_dot(nsvcd__farthest(tree, node, direction), direction);
  const float *corners = tree->corners + 9 * (size_t)node->first;
  double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < node->count; i++) {
    for (size_t k = 0; k < 3; k++) {
      const nsvcd__d3 corner = nsvcd__d3_row(corners, 3 * i + k);
      most[k] = nsvcd__max(nsvcd__d3_dot(corner, direction), most[k]);
    }
  }
  return nsvcd__max(most[0], nsvcd__max(most[1], most[2]));
}

// How far apart two nodes are along a direction, times its length.
static double nsvcd__distance_along(const nsvcd__tree_interval *s,
                                    const nsvcd__node_pair *pair, const nsvcd__instant *at,
                                    nsvcd__d3 along) {
  double extents = 0;
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__moving *body = &s->bodies[n];
    const nsvcd__d3 in = nsvcd__inward(at, n, along);
    extents += body->model.scale * nsvcd__extent_along(body->tree, &pair->nodes[n], in);
  }
  return nsvcd__d3_dot(along, nsvcd__offset_at(at)) - extents;
}

static double nsvcd__node_radius(const nsvcd__moving *moving, const nsvcd__node *node) {
  const nsvcd__box *box = &moving->tree->boxes[node->box];
  const nsvcd__f3 corner = nsvcd__f3_max(box->high, nsvcd__f3_scale(box->low, -1));
  return 1.000002 * moving->model.scale * nsvcd__d3_norm(nsvcd__d3_widen(corner));
}

// No point of a node is farther from the line through its body's origin along a unit axis.
static double nsvcd__node_axis_radius(const nsvcd__moving *moving, const nsvcd__node *node,
                                      nsvcd__d3 axis) {
  const float *corners = moving->tree->corners + 9 * (size_t)node->first;
  const size_t count = node->count > NSVCD__EXACT ? 0 : 3 * (size_t)node->count;
  double square = 0;
  for (size_t i = 0; i < count; i++) {
    const nsvcd__d3 off = nsvcd__d3_cross(nsvcd__d3_row(corners, i), axis);
    square = nsvcd__max(square, nsvcd__d3_dot(off, off));
  }
  if (count == 0) {
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
  return 1.000002 * moving->model.scale * sqrt(square);
}

// How far points of a node leave their chords after an instant along a direction, times its length.
static double nsvcd__node_deviation(const nsvcd__moving *body, const nsvcd__node_pair *pair,
                                    const nsvcd__instant *at, size_t n, nsvcd__d3 along) {
  const nsvcd_deviation *d = &at->deviations[n];
  const double any = nsvcd__d3_norm(along) * (d->base + d->per_metre * pair->radii[n]);
  if (!(d->turn > 0)) return any;
  const nsvcd__d3 own = nsvcd__d3_of(d->axis[0], d->axis[1], d->axis[2]);
  const nsvcd__d3 axis = nsvcd__dmat3_apply(&at->poses[n].rotation, own);
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(along, axis));
  return any + d->turn * across * nsvcd__node_axis_radius(body, &pair->nodes[n], own);
}

// How much farther apart two nodes are along a direction than they have to be, times its length:
// the least at all instants and between them. Ends as soon as it is no more than `enough`.
static double nsvcd__slack_along(const nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                                 nsvcd__d3 along, double enough) {
  const double length = nsvcd__d3_norm(along);
  double slack = HUGE_VAL;
  double last = HUGE_VAL;
  double last_lengths = 0;
  double deviation = 0;
  for (size_t i = 0; i < s->count && slack > enough; i++) {
    const nsvcd__instant *at = &s->instants[i];
    const double lengths = pair->radii[0] + pair->radii[1] + s->clearance + at->lengths;
    const double distance = nsvcd__distance_along(s, pair, at, along);
    const double margin = NSVCD__CERTIFIED_MARGIN * nsvcd__max(lengths, last_lengths);
    const double least = length * (s->clearance + margin) + deviation;
    slack = nsvcd__min(slack, nsvcd__min(distance, last) - least);
    last = distance;
    last_lengths = lengths;
    deviation = 0;
    for (size_t n = 0; n < 2; n++)
      deviation += nsvcd__node_deviation(&s->bodies[n], pair, at, n, along);
  }
  return slack;
}

// Does a plane of this normal separate two nodes, at all instants and between them?
static int nsvcd__separates(const nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                            nsvcd__d3 along) {
  return nsvcd__slack_along(s, pair, along, 0) > 0;
}

// ---- normals

static double nsvcd__signed(double magnitude, double sign) {
  return sign < 0 ? -magnitude : magnitude;
}

// A direction in two whole numbers: a point of the octahedron |x| + |y| + |z| = half, seen from
// above, its lower half folded outwards (Meyer and others 2010).
static nsvcd__coded_normal nsvcd__normal_of(nsvcd__d3 along, int bits) {
  const double half = (double)((1 << (bits - 1)) - 1);
  const double sum = fabs(along.x) + fabs(along.y) + fabs(along.z);
  const double x = along.x * (half / sum);
  const double y = along.y * (half / sum);
  const int below = along.z < 0;
  nsvcd__coded_normal out;
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

// A direction, and how far apart two nodes are along it half way; less than 0: not at all.
typedef struct nsvcd__best {
  nsvcd__d3 along;
  double distance;
} nsvcd__best;

// Gilbert's iteration (1966) towards the point of a - b that is nearest to the origin. It ends
// where the best direction is nearly as good as the nearest point allows.
static nsvcd__best nsvcd__gilbert(const nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                                  const nsvcd__instant *at, nsvcd__d3 along) {
  nsvcd__best best = {along, -HUGE_VAL};
  nsvcd__d3 v = nsvcd__least_apart(s, pair, at, along);
  const double first = nsvcd__d3_norm(v);
  for (int n = 0; n < NSVCD__GILBERT_STEPS; n++) {
    const double length = nsvcd__d3_norm(v);
    if (!(length > NSVCD__GILBERT_LEAST * first)) break;
    const nsvcd__d3 w = nsvcd__least_apart(s, pair, at, v);
    const double distance = nsvcd__d3_dot(v, w) / length;
    if (distance > best.distance) {
      best.along = v;
      best.distance = distance;
    }
    if (distance - s->clearance > NSVCD__GILBERT_ENOUGH * (length - s->clearance)) break;
    const nsvcd__d3 to = nsvcd__d3_sub(w, v);
    const double square = nsvcd__d3_dot(to, to);
    if (!(square > 0)) break;
    const double fraction = -nsvcd__d3_dot(v, to) / square;
    v = nsvcd__d3_fma(nsvcd__max(0, nsvcd__min(fraction, 1)), to, v);
  }
  return best;
}

// Looks for a plane that separates two nodes for the whole interval. *best: the direction to begin
// with; it becomes the best one half way.
static int nsvcd__find_normal(nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                              nsvcd__best *best, nsvcd__coded_normal *normal) {
  nsvcd__instant *at = &s->middle;
  if (at->t < 0) *at = nsvcd__instant_at(s->bodies, 0.5 * (s->t0 + s->t1));
  if (nsvcd__are_leaves(pair)) {
    nsvcd__d3 t[2][3];
    for (size_t i = 0; i < 6; i++) {
      const size_t n = i / 3;
      const nsvcd__moving *body = &s->bodies[n];
      const float *corners = body->tree->corners + 9 * (size_t)pair->nodes[n].first;
      const nsvcd__d3 x = nsvcd__d3_row(corners, i % 3);
      t[n][i % 3] = nsvcd__turned_by(body, &at->poses[n], x);
    }
    for (size_t k = 0; k < 3; k++) t[0][k] = nsvcd__d3_add(t[0][k], nsvcd__offset_at(at));
    const nsvcd__nearest nearest = nsvcd__nearest_of(t[0], t[1]);
    best->along = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    best->distance = sqrt(nearest.square);
  } else {
    *best = nsvcd__gilbert(s, pair, at, best->along);
  }
  if (!(best->distance > s->clearance)) return 0;
  for (int bits = 8; bits <= 24; bits += 8) {
    *normal = nsvcd__normal_of(best->along, bits);
    if (nsvcd__separates(s, pair, normal->along)) return 1;
  }
  return 0;
}
