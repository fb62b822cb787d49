// In: two motion models and two trees. Out: a certificate, or none. The form of its bits:
//
//   all       version 1 (6 bits), kind (2), digests of both meshes (8 each), of motions, scales and
//             the clearance (16)
//   FREE      the traversal, a code a visit, as examples/verify/nsvcd_verify.h has it: 0 opens the
//             node whose box is longer; 11 separated by the last normal; 101 by another, which
//             follows; 100 halves the time. Where the roots are nowhere separated: a ray for each
//             component of a, then of b, at t = 0: 1 along the last normal, or 0, and a normal
//   others    the time (32), then HIT: two triangles (32 each), whose edge (1), which (2); NEAR:
//             two triangles, a point on each (16, 16); INSIDE: whose corner (1), which (32), a
//             normal
//   a normal  the last eight are remembered: k zeros and a 1 are the one k + 1 before the last;
//             seven zeros a new one: 0, two numbers of 8 bits; 10, two of 16; 11, two of 24
#pragma once
#include "rays.h"

// visits on the stack
#define NSVCD__TRAVERSAL_STACK 128
#define NSVCD__NO_EDGE 3u
#define NSVCD__SHORTEST_INTERVAL 1e-12
// normals
#define NSVCD__REMEMBERED 8
// of both nodes' sides: where they move farther, the time is halved
#define NSVCD__LONG_TRAVEL 0.35

enum { NSVCD__PROVES_FREE, NSVCD__PROVES_HIT, NSVCD__PROVES_NEAR, NSVCD__PROVES_INSIDE };

typedef struct nsvcd__visit {
  nsvcd__node_pair pair;
  double t0, t1;
} nsvcd__visit;

typedef struct nsvcd__certifier {
  nsvcd__moving bodies[2];
  nsvcd__tree_interval interval;
  // the last first
  nsvcd__d3 normals[NSVCD__REMEMBERED];
  uint8_t *bytes;
  size_t capacity, bits;
  // of motions, scales and the clearance
  uint32_t digest;
  // 1: the roots are, at some time
  int separated;
  // (vertices)
  int32_t *sums;
  nsvcd_certificate *made;
} nsvcd__certifier;

// ---- writing

static void nsvcd__write_bits(nsvcd__certifier *c, uint32_t value, int count) {
  while (count-- > 0) {
    const size_t at = c->bits / 8;
    if (at < c->capacity && c->bits % 8 == 0) c->bytes[at] = 0;
    if (at < c->capacity && (value >> count & 1))
      c->bytes[at] = (uint8_t)(c->bytes[at] | 0x80u >> c->bits % 8);
    c->bits++;
  }
}

// The normal that is k > 0 before the last, or, where k is REMEMBERED, a new one. It becomes the
// last.
static void nsvcd__write_normal(nsvcd__certifier *c, size_t k,
                                const nsvcd__coded_normal *normal) {
  const int known = k < NSVCD__REMEMBERED;
  const nsvcd__d3 along = known ? c->normals[k] : normal->along;
  nsvcd__write_bits(c, (uint32_t)known, (int)(known ? k : k - 1));
  if (!known) {
    const uint32_t bytes = (uint32_t)normal->bits / 8;
    nsvcd__write_bits(c, bytes > 1 ? bytes : 0, bytes > 1 ? 2 : 1);
    nsvcd__write_bits(c, normal->x, normal->bits);
    nsvcd__write_bits(c, normal->y, normal->bits);
    k--;
  }
  for (; k > 0; k--) c->normals[k] = c->normals[k - 1];
  c->normals[0] = along;
}

static void nsvcd__write_head(nsvcd__certifier *c, uint32_t kind) {
  const uint32_t digests[3] = {c->bodies[0].tree->digest, c->bodies[1].tree->digest,
                               c->digest};
  c->bits = 0;
  // a reader has none yet
  memset(c->normals, 0, sizeof c->normals);
  nsvcd__write_bits(c, 1, 6);
  nsvcd__write_bits(c, kind, 2);
  for (size_t k = 0; k < 3; k++) {
    const uint32_t half = digests[k] ^ digests[k] >> 16;
    nsvcd__write_bits(c, k < 2 ? (half ^ half >> 8) & 0xff : half & 0xffff, k < 2 ? 8 : 16);
  }
}

// ---- hits

// The edge of a triangle that passes through one of the other body, if there is one.
static uint32_t nsvcd__piercing_edge(const nsvcd__seen *s, uint32_t own, uint32_t other) {
  nsvcd__d3 corners[3];
  nsvcd__seen_triangle(s, own, corners);
  for (uint32_t k = 0; k < 3; k++) {
    const nsvcd__d3 to = corners[(k + 1) % 3];
    const nsvcd__d3 along = nsvcd__d3_sub(to, corners[k]);
    const int there = nsvcd__ray_passes(s, other, corners[k], along);
    if (there != 1 && there != -1) continue;
    const nsvcd__d3 back = nsvcd__d3_scale(along, -1);
    if (nsvcd__ray_passes(s, other, to, back) == -there) return k;
  }
  return NSVCD__NO_EDGE;
}

// A point of a triangle as it is written. The line from the first corner through it meets the side
// opposite: code[0] is the point's fraction of that line, code[1] where on the side they meet.
// Returns the point that is read.
static nsvcd__d3 nsvcd__point_code(const nsvcd__d3 *t, nsvcd__d3 x, uint32_t *code) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  const nsvcd__d3 off = nsvcd__d3_sub(x, t[0]);
  const nsvcd__d3 first = nsvcd__d3_sub(t[1], t[0]);
  const nsvcd__d3 second = nsvcd__d3_sub(t[2], t[1]);
  const double square = nsvcd__d3_dot(n, n);
  // off = v (first + w second)
  const double vw = nsvcd__d3_dot(n, nsvcd__d3_cross(first, off)) / square;
  const double v =
      vw + nsvcd__d3_dot(n, nsvcd__d3_cross(off, nsvcd__d3_sub(t[2], t[0]))) / square;
  const int has_area = square > 0 && v > 0;
  code[0] = (uint32_t)(65535 * nsvcd__clamp_fraction(has_area ? v : 0) + 0.5);
  code[1] = (uint32_t)(65535 * nsvcd__clamp_fraction(has_area ? vw / v : 0) + 0.5);
  const nsvcd__d3 along = nsvcd__d3_fma((double)code[1] / 65535, second, first);
  return nsvcd__d3_fma((double)code[0] / 65535, along, t[0]);
}

// Are two triangles nearer to each other than the clearance, at points as they are written?
static int nsvcd__near_at(const nsvcd__certifier *c, const nsvcd__seen *s, uint32_t ta,
                          uint32_t tb, uint32_t *codes) {
  nsvcd__d3 a[3], b[3];
  nsvcd__seen own = *s;
  own.of = s->by;
  own.of_at = s->by_at;
  nsvcd__seen_triangle(s, ta, a);
  nsvcd__seen_triangle(&own, tb, b);
  const nsvcd__nearest nearest = nsvcd__nearest_of(a, b);
  const nsvcd__d3 on_a = nsvcd__point_code(a, nearest.on_a, codes);
  const nsvcd__d3 on_b = nsvcd__point_code(b, nearest.on_b, codes + 2);
  const double distance = sqrt(nsvcd__d3_distance2(on_a, on_b)) + s->margin;
  return s->by->model.scale * distance < c->interval.clearance;
}

// Do two triangles meet at a time, or come within the clearance? Then it writes the certificate.
static int nsvcd__meet_at(nsvcd__certifier *c, double when, uint32_t ta, uint32_t tb) {
  // the nearest time that can be written
  const double most = 4294967295.0;
  const uint32_t code = (uint32_t)(nsvcd__max(0, nsvcd__min(when, 1)) * most + 0.5);
  const double t = (double)code / most;
  const nsvcd__seen a = nsvcd__seen_at(&c->bodies[0], &c->bodies[1], t);
  const nsvcd__seen b = nsvcd__seen_at(&c->bodies[1], &c->bodies[0], t);
  uint32_t points[4];
  uint32_t edge = nsvcd__piercing_edge(&a, ta, tb);
  const uint32_t whose = edge == NSVCD__NO_EDGE;
  if (whose) edge = nsvcd__piercing_edge(&b, tb, ta);
  const int pierced = edge != NSVCD__NO_EDGE;
  if (!pierced && !(c->interval.clearance > 0 && nsvcd__near_at(c, &a, ta, tb, points)))
    return 0;
  nsvcd__write_head(c, pierced ? NSVCD__PROVES_HIT : NSVCD__PROVES_NEAR);
  nsvcd__write_bits(c, code, 32);
  nsvcd__write_bits(c, ta, 32);
  nsvcd__write_bits(c, tb, 32);
  if (pierced) {
    nsvcd__write_bits(c, whose, 1);
    nsvcd__write_bits(c, edge, 2);
  }
  for (size_t k = 0; k < 4 && !pierced; k++) nsvcd__write_bits(c, points[k], 16);
  c->made->verdict = NSVCD_HIT;
  c->made->time = t;
  return 1;
}

// ---- the traversal

// The longest side of a node's box.
static double nsvcd__node_side(const nsvcd__moving *moving, const nsvcd__node *node) {
  const nsvcd__box *box = &moving->tree->boxes[node->box];
  const nsvcd__d3 low = nsvcd__d3_widen(box->low);
  const nsvcd__d3 high = nsvcd__d3_widen(box->high);
  const nsvcd__d3 sides = nsvcd__d3_sub(high, low);
  return nsvcd__stored(moving->model.scale *
                       nsvcd__max(nsvcd__max(sides.x, sides.y), sides.z));
}

// How far one node's middle moves relative to the other's, from instant to instant.
static double nsvcd__relative_travel(const nsvcd__tree_interval *s,
                                     const nsvcd__node_pair *pair) {
  double travel = 0;
  nsvcd__d3 last = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__instant *at = &s->instants[i];
    nsvcd__d3 middles[2];
    for (size_t n = 0; n < 2; n++) {
      const nsvcd__moving *body = &s->bodies[n];
      const nsvcd__box *box = &body->tree->boxes[pair->nodes[n].box];
      const nsvcd__d3 sum =
          nsvcd__d3_add(nsvcd__d3_widen(box->low), nsvcd__d3_widen(box->high));
      middles[n] = nsvcd__turned_by(body, &at->poses[n], nsvcd__d3_scale(sum, 0.5));
    }
    const nsvcd__d3 now =
        nsvcd__d3_add(nsvcd__d3_sub(middles[0], middles[1]), nsvcd__offset_at(at));
    if (i > 0) travel += sqrt(nsvcd__d3_distance2(now, last));
    last = now;
  }
  return travel;
}

// Is the interval what keeps two nodes from being separated, rather than their size? sides: (2) of
// the nodes. best: the best direction half way.
static int nsvcd__is_too_long(const nsvcd__certifier *c, const nsvcd__node_pair *pair,
                              const double *sides, const nsvcd__best *best) {
  const double travel = nsvcd__relative_travel(&c->interval, pair);
  const double apart = best->distance - c->interval.clearance;
  if (!(apart > 0)) return travel > NSVCD__LONG_TRAVEL * (sides[0] + sides[1]);
  // half way they are separated: smaller nodes are needed only where these hardly move
  if (travel > 2 * NSVCD__LONG_TRAVEL * nsvcd__min(sides[0], sides[1])) return 1;
  const double least = -apart * nsvcd__d3_norm(best->along);
  return nsvcd__slack_along(&c->interval, pair, best->along, least) > least;
}

// Replaces a visit by two, in reverse order: to the children of the node whose box is longer, or in
// both halves of the time. Returns 0 where that is too short to halve.
static int nsvcd__divide_visit(nsvcd__certifier *c, nsvcd__visit *v, const nsvcd__best *best) {
  nsvcd__node *nodes = v->pair.nodes;
  const double sides[2] = {nsvcd__node_side(&c->bodies[0], &nodes[0]),
                           nsvcd__node_side(&c->bodies[1], &nodes[1])};
  const int halves =
      nsvcd__are_leaves(&v->pair) || nsvcd__is_too_long(c, &v->pair, sides, best);
  v[1] = *v;
  nsvcd__write_bits(c, halves ? 4 : 0, halves ? 3 : 1);
  if (halves) {
    v[1].t1 = v->t0 = 0.5 * (v->t0 + v->t1);
    return v->t1 - v[1].t0 >= NSVCD__SHORTEST_INTERVAL;
  }
  const size_t n = nodes[1].count > 1 && (nodes[0].count == 1 || sides[0] < sides[1]);
  nsvcd__children(&nodes[n], &v[1].pair.nodes[n], &nodes[n]);
  return 1;
}

// Depth first, over pairs of nodes and intervals of time. HIT: the certificate is that of a hit;
// FREE: that of all of t0 to t1.
static nsvcd_verdict nsvcd__prove_traversal(nsvcd__certifier *c, double t0, double t1,
                                            size_t visits) {
  nsvcd__visit stack[NSVCD__TRAVERSAL_STACK];
  size_t height = 1;
  int is_unresolved = 0;
  memset(stack, 0, sizeof *stack);
  for (size_t n = 0; n < 2; n++)
    stack->pair.nodes[n].count = (uint32_t)c->bodies[n].tree->mesh.triangle_count;
  stack->t0 = t0;
  stack->t1 = t1;
  c->separated = 0;
  nsvcd__write_head(c, NSVCD__PROVES_FREE);
  while (height > 0) {
    nsvcd__visit *v = &stack[height - 1];
    nsvcd__node_pair *pair = &v->pair;
    nsvcd__best best = {c->normals[0], 0};
    nsvcd__coded_normal normal;
    for (size_t n = 0; n < 2; n++)
      pair->radii[n] = nsvcd__node_radius(&c->bodies[n], &pair->nodes[n]);
    if (c->made->visits >= visits) {
      c->made->why = NSVCD_WHY_WORK;
      return NSVCD_UNDECIDED;
    }
    c->made->visits++;
    if (!nsvcd__tree_interval_to(&c->interval, v->t0, v->t1)) return NSVCD_UNDECIDED;
    size_t k = 0;
    while (k < NSVCD__REMEMBERED && !nsvcd__separates(&c->interval, pair, c->normals[k])) k++;
    if (k < NSVCD__REMEMBERED || nsvcd__find_normal(&c->interval, pair, &best, &normal)) {
      nsvcd__write_bits(c, k > 0 ? 5 : 3, k > 0 ? 3 : 2);
      if (k > 0) nsvcd__write_normal(c, k, &normal);
      if (pair->nodes[0].box == 0 && pair->nodes[1].box == 0) c->separated = 1;
      height--;
      continue;
    }
    if (nsvcd__are_leaves(pair)) {
      const uint32_t ta = c->bodies[0].tree->order[pair->nodes[0].first];
      const uint32_t tb = c->bodies[1].tree->order[pair->nodes[1].first];
      if (nsvcd__meet_at(c, 0.5 * (v->t0 + v->t1), ta, tb)) return NSVCD_HIT;
    }
    if (height == NSVCD__TRAVERSAL_STACK) return NSVCD_UNDECIDED;
    if (nsvcd__divide_visit(c, v, &best)) {
      height++;
      continue;
    }
    // they touch, or nearly: others may still be proven to meet
    is_unresolved = 1;
    height--;
  }
  if (is_unresolved) c->made->why = NSVCD_WHY_TOO_NEAR;
  return is_unresolved ? NSVCD_UNDECIDED : NSVCD_FREE;
}
