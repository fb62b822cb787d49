// part.h - planes that part what is at two places of the trees over a whole span.
// In: a span (motion.h), children of both trees, triangles. Out: gaps: how far apart the two sides
// are along the best of the planes tried, less all that either may stray from where it is thought
// to be. Above 0 they are parted over all of the span; a NaN is not above 0.
//
// Along a direction n, |n| <= 1, the moving side reaches from the least to the greatest of its
// places at both ends (a chord is convex), less and more its stray ea + eb reach. A box reaches by
// |m| . half about its centre, m being n as the box's body sees it. A slab (offsets low to high
// along v) with its box about c: m.y = s v.y + (m - s v).y for any s, so it reaches from
// s low + d.c - |d| . half on, d = m - s v, which is exact where the slab has turned along.
#ifndef LOOP_PART_H
#define LOOP_PART_H

#include "certify.h"
#include "motion.h"

FAST float less(float a, float b) {
  return a < b ? a : b;
}
FAST float more(float a, float b) {
  return a > b ? a : b;
}

// ---- one child of each

// A box of a over a span, along b's axes, stray taken off and added.
static void box_over_span(const span *s, const tree_child *c, float *low, float *high) {
  for (int j = 0; j < 3; j++) {
    const float *m = s->at_start[j];
    const float *e = s->at_end[j];
    const float stray = s->axes_ea[j] + s->axes_eb[j] * c->reach;
    const float start = dot3(m, c->centre) + s->start_height[j];
    const float end = dot3(e, c->centre) + s->end_height[j];
    const float start_by =
        fabsf(m[0]) * c->half[0] + fabsf(m[1]) * c->half[1] + fabsf(m[2]) * c->half[2] + stray;
    const float end_by =
        fabsf(e[0]) * c->half[0] + fabsf(e[1]) * c->half[1] + fabsf(e[2]) * c->half[2] + stray;
    low[j] = less(start - start_by, end - end_by);
    high[j] = more(start + start_by, end + end_by);
  }
}

// The gap of two boxes along n.
static float gap_along(const span *s, const tree_child *a, const tree_child *b, const float *n) {
  float m[3];
  float e[3];
  turn_back(s->start, n, m);
  turn_back(s->end, n, e);
  float rest = dot3(n, b->centre);
  float start = dot3(n, s->start_at) + dot3(m, a->centre);
  float end = dot3(n, s->end_at) + dot3(e, a->centre);
  float by = stray_of(s, n, a->reach) + s->rounding;
  float start_by = by;
  float end_by = by;
  by = 0;
  for (int k = 0; k < 3; k++) {
    start_by += fabsf(m[k]) * a->half[k];
    end_by += fabsf(e[k]) * a->half[k];
    by += fabsf(n[k]) * b->half[k];
  }
  return more(less(start - start_by, end - end_by) - (rest + by),
              (rest - by) - more(start + start_by, end + end_by));
}

// The gap of two boxes: along the faces of both and across the line between their centres.
static float pair_gap(const span *s, const tree_child *a, const tree_child *b) {
  float n[3];
  float gap = -HUGE_VALF;
  for (int j = 0; j < 6 && !(gap > 0); j++) {
    gap = more(gap, gap_along(s, a, b, s->axes[j]));
    LOOP_AXIS(0, lanes_set(gap), lanes3_row(s->axes[j]));
  }
  for (int k = 0; k < 3; k++)
    n[k] = dot3(s->at_start[k], a->centre) + s->start_height[k] + dot3(s->at_end[k], a->centre) +
           s->end_height[k] - 2 * b->centre[k];
  const float square = dot3(n, n);
  const float unit = square > 1e-30f ? 0.999999f / sqrtf(square) : 0;
  for (int k = 0; k < 3; k++)
    n[k] *= unit;
  gap = more(gap, gap_along(s, a, b, n));
  LOOP_AXIS(0, lanes_set(gap), lanes3_row(n));
  return gap;
}

// ---- one child of each, arc by arc

// The widest of the intervals' gaps so far.
FAST lanes wider(lanes gap, lanes low, lanes high, lanes other_low, lanes other_high) {
  return lanes_max(gap, lanes_max(low - other_high, other_low - high));
}

#define MOST_ARCS 64  // that are looked at together

// What a child of a does at knots of a span, and how far it is from one of b in the arcs after them.
typedef struct arc_places {
  float at[3][MOST_ARCS + 2 * LANES];  // of its centre
  float by[4][MOST_ARCS + 2 * LANES];  // of its box, along b's axes and the normal of b's slab
  float rounding[MOST_ARCS + 2 * LANES];
  float gaps[MOST_ARCS + LANES];
} arc_places;

// How far a box of a reaches along v at 16 knots.
FAST lanes box_by(const knot_table *k, uint32_t n, lanes3 v, const float *half) {
  lanes sum = lanes_set(0);
  for (int c = 0; c < 3; c++) {
    const lanes along = v.x * lanes_load(k->matrix[c] + n) + v.y * lanes_load(k->matrix[3 + c] + n) +
                        v.z * lanes_load(k->matrix[6 + c] + n);
    sum += lanes_abs(along) * half[c];
  }
  return sum;
}

static void place_arcs(const motion *m, uint32_t first, uint32_t count, const tree_child *a,
                       const float *normal, arc_places *out) {
  const knot_table *k = &m->knots;
  const lanes3 v = lanes3_set(normal[0], normal[1], normal[2]);
  for (uint32_t i = 0; i <= count; i += LANES) {
    const uint32_t n = first + i;
    lanes remote = lanes_set(m->lengths);
    for (int r = 0; r < 3; r++) {
      const lanes x = lanes_load(k->matrix[3 * r] + n);
      const lanes y = lanes_load(k->matrix[3 * r + 1] + n);
      const lanes z = lanes_load(k->matrix[3 * r + 2] + n);
      const lanes place = lanes_load(k->place[r] + n);
      remote += lanes_abs(place);
      lanes_store(out->at[r] + i, x * a->centre[0] + y * a->centre[1] + z * a->centre[2] + place);
      lanes_store(out->by[r] + i, lanes_abs(x) * a->half[0] + lanes_abs(y) * a->half[1] +
                                      lanes_abs(z) * a->half[2]);
    }
    lanes_store(out->by[3] + i, box_by(k, n, v, a->half));
    lanes_store(out->rounding + i, NSVCD__ROUNDING * remote);
  }
}

FAST lanes3 lanes3_load(const float (*rows)[MOST_ARCS + 2 * LANES], uint32_t i) {
  return (lanes3){lanes_load(rows[0] + i), lanes_load(rows[1] + i), lanes_load(rows[2] + i)};
}

// Of `count` arcs from knot `first` on, those in which two children may meet: each arc by itself is
// a span, of which the knots are the ends and the bulge is all of the stray. Planes are b's faces
// and slab, and one across the line between the centres.
static uint64_t arcs_met(const motion *m, uint32_t first, uint32_t count, const tree_child *a,
                         const tree_child *b, arc_places *out) {
  const knot_table *k = &m->knots;
  const lanes3 centre = lanes3_set(b->centre[0], b->centre[1], b->centre[2]);
  const lanes3 half = lanes3_set(b->half[0], b->half[1], b->half[2]);
  const lanes3 normal = lanes3_set(b->normal[0], b->normal[1], b->normal[2]);
  uint64_t met = 0;
  place_arcs(m, first, count, a, b->normal, out);
  for (uint32_t i = 0; i < count; i += LANES) {
    const uint32_t n = first + i;
    const lanes3 start = lanes3_load(out->at, i);
    const lanes3 end = lanes3_load(out->at, i + 1);
    const lanes3 start_by = lanes3_load(out->by, i);
    const lanes3 end_by = lanes3_load(out->by, i + 1);
    const lanes stray = lanes_load(k->drift + n) + lanes_load(k->bulge + n) * lanes_set(a->reach) +
                        lanes_load(out->rounding + i) + lanes_load(out->rounding + i + 1) +
                        m->clearance;
    const lanes *s = &start.x;
    const lanes *e = &end.x;
    lanes gap = lanes_set(-HUGE_VALF);
    for (int r = 0; r < 3; r++) {
      const lanes low = lanes_min(s[r] - (&start_by.x)[r], e[r] - (&end_by.x)[r]) - stray;
      const lanes high = lanes_max(s[r] + (&start_by.x)[r], e[r] + (&end_by.x)[r]) + stray;
      gap = wider(gap, low, high, lanes_set(b->centre[r] - b->half[r]),
                  lanes_set(b->centre[r] + b->half[r]));
      LOOP_AXIS(i, gap, lanes3_set(r == 0, r == 1, r == 2));
    }
    const lanes slab_start = lanes3_dot(start, normal);
    const lanes slab_end = lanes3_dot(end, normal);
    const lanes slab_by = lanes_load(out->by[3] + i);
    const lanes slab_end_by = lanes_load(out->by[3] + i + 1);
    gap = wider(gap, lanes_min(slab_start - slab_by, slab_end - slab_end_by) - stray,
                lanes_max(slab_start + slab_by, slab_end + slab_end_by) + stray,
                lanes_set(b->slab[0]), lanes_set(b->slab[1]));
    LOOP_AXIS(i, gap, normal);
    const lanes3 way =
        lanes3_unit(lanes3_sub(lanes3_add(start, end), lanes3_scale(centre, lanes_set(2))));
    const lanes rest = lanes3_dot(centre, way) + lanes3_dot(lanes3_abs(way), half);
    const lanes near_start = lanes3_dot(start, way) - box_by(k, n, way, a->half);
    const lanes near_end = lanes3_dot(end, way) - box_by(k, n + 1, way, a->half);
    gap = lanes_max(gap, lanes_min(near_start, near_end) - stray - rest);
    LOOP_AXIS(i, gap, way);
    lanes_store(out->gaps + i, gap);
    const uint32_t parted = lanes_above(gap, lanes_set(0));
    met |= (uint64_t)(first_lanes(count - i) & ~parted) << i;
  }
  return met;
}

// ---- 16 children

// A child of a as it moves in a span; what follows the reach is not always asked for.
typedef struct moving_child {
  float start[3], end[3], half[3], reach;  // its centre, its box in its body
  float low[6], high[6];                   // along the span's axes, stray taken off and added
  float normal[3], slab_low, slab_high;    // its slab's half way, in b's frame, likewise
} moving_child;

// The same of 16.
typedef struct moving_children {
  lanes3 start, end, half;
  lanes reach;
  lanes low[6], high[6];
  lanes3 normal;
  lanes slab_low, slab_high;
  lanes3 centre;  // in its body
  const tree_node *node;
  uint64_t span;
  uint32_t there;
  int all;  // not only along b's axes
} moving_children;

FAST void child_of_lane(const moving_children *of, unsigned l, moving_child *out) {
  const float *from = (const float *)of + l;
  float *to = (float *)out;
  for (size_t k = 0; k < sizeof *out / sizeof *to; k++)
    to[k] = from[LANES * k];
}

// 16 children of b, and what of them does not depend on a's.
typedef struct resting_children {
  lanes low[6], high[6];  // along the span's axes
  lanes3 normal;
  lanes slab_low, slab_high;
  lanes3 by_start, by_end;  // of their slabs' normals, as a sees them, each component's size
  lanes along, across;      // by which a strays along these
  uint32_t there;
} resting_children;

// Boxes of a along axis j.
FAST void boxes_along(const span *s, int j, lanes3 centre, lanes3 half, moving_children *out) {
  const float *m = s->at_start[j];
  const float *e = s->at_end[j];
  const lanes stray = s->axes_ea[j] + s->axes_eb[j] * out->reach;
  const lanes start = m[0] * centre.x + m[1] * centre.y + m[2] * centre.z + s->start_height[j];
  const lanes end = e[0] * centre.x + e[1] * centre.y + e[2] * centre.z + s->end_height[j];
  const lanes start_by = fabsf(m[0]) * half.x + fabsf(m[1]) * half.y + fabsf(m[2]) * half.z + stray;
  const lanes end_by = fabsf(e[0]) * half.x + fabsf(e[1]) * half.y + fabsf(e[2]) * half.z + stray;
  out->low[j] = lanes_min(start - start_by, end - end_by);
  out->high[j] = lanes_max(start + start_by, end + end_by);
  if (j < 3) {
    (&out->start.x)[j] = start;
    (&out->end.x)[j] = end;
  }
}

static void move_along_b(const span *s, const tree_body *body, const tree_node *node,
                         moving_children *out) {
  const tree_children c = children_of(body, node);
  const lanes3 centre = lanes3_scale(lanes3_add(c.low, c.high), lanes_set(0.5f));
  out->centre = centre;
  out->node = node;
  out->span = s->id;
  out->there = c.there;
  out->all = 0;
  out->half = lanes3_scale(lanes3_sub(c.high, c.low), lanes_set(0.5f));
  out->reach = c.reach;
  for (int j = 0; j < 3; j++)
    boxes_along(s, j, centre, out->half, out);
}

// Along a's own axes half way too, and its slabs.
static void move_all(const span *s, float scale, const tree_body *body, moving_children *out) {
  const tree_children c = children_of(body, out->node);
  const lanes3 centre = out->centre;
  const lanes zero = lanes_set(0);
  float half_way[9];
  out->all = 1;
  for (int j = 0; j < 3; j++) {
    boxes_along(s, 3 + j, centre, out->half, out);
    for (int k = 0; k < 3; k++)
      half_way[3 * j + k] = s->axes[3 + j][k];
  }
  const lanes3 normal = lanes3_unit(lanes3_turn_back(half_way, c.normal));
  const lanes3 turned = lanes3_scale(c.normal, lanes_set(scale));
  const lanes3 by_start = lanes3_sub(lanes3_turn_back(s->start, normal), turned);
  const lanes3 by_end = lanes3_sub(lanes3_turn_back(s->end, normal), turned);
  const float *p = s->start_at;
  const float *q = s->end_at;
  const lanes start = lanes3_dot(normal, lanes3_set(p[0], p[1], p[2])) + lanes3_dot(by_start, centre);
  const lanes end = lanes3_dot(normal, lanes3_set(q[0], q[1], q[2])) + lanes3_dot(by_end, centre);
  const lanes along = lanes_abs(normal.x * s->w[0] + normal.y * s->w[1] + normal.z * s->w[2]);
  const lanes across = lanes_sqrt(lanes_max(1.000004f - along * along, zero));
  const lanes stray = along * (s->ea_w + s->eb_w * out->reach) +
                      across * (s->ea + s->eb * out->reach) + s->rounding;
  const lanes start_by = lanes3_dot(lanes3_abs(by_start), out->half) + stray;
  const lanes end_by = lanes3_dot(lanes3_abs(by_end), out->half) + stray;
  out->normal = normal;
  out->slab_low = lanes_min(start - start_by, end - end_by) + scale * c.slab_low;
  out->slab_high = lanes_max(start + start_by, end + end_by) + scale * c.slab_high;
}

static void rest_all(const span *s, const tree_body *body, const tree_node *node,
                     resting_children *out) {
  const tree_children c = children_of(body, node);
  const lanes3 centre = lanes3_scale(lanes3_add(c.low, c.high), lanes_set(0.5f));
  const lanes3 half = lanes3_scale(lanes3_sub(c.high, c.low), lanes_set(0.5f));
  for (int j = 0; j < 3; j++) {
    const float *n = s->axes[3 + j];
    const lanes at = n[0] * centre.x + n[1] * centre.y + n[2] * centre.z;
    const lanes by = fabsf(n[0]) * half.x + fabsf(n[1]) * half.y + fabsf(n[2]) * half.z;
    out->low[j] = (&c.low.x)[j];
    out->high[j] = (&c.high.x)[j];
    out->low[3 + j] = at - by;
    out->high[3 + j] = at + by;
  }
  const lanes3 n = c.normal;
  out->normal = n;
  out->slab_low = c.slab_low;
  out->slab_high = c.slab_high;
  out->by_start = lanes3_abs(lanes3_turn_back(s->start, n));
  out->by_end = lanes3_abs(lanes3_turn_back(s->end, n));
  out->along = lanes_abs(n.x * s->w[0] + n.y * s->w[1] + n.z * s->w[2]);
  out->across = lanes_sqrt(lanes_max(1.000004f - out->along * out->along, lanes_set(0)));
  out->there = c.there;
}

// ---- one child of one tree and 16 of the other. Both return the lanes that still meet.

static uint32_t part_resting(const span *s, const moving_child *a, const resting_children *b,
                             lanes *gaps) {
  lanes gap = lanes_set(-HUGE_VALF);
  for (int j = 0; j < 6; j++) {
    gap = wider(gap, b->low[j], b->high[j], lanes_set(a->low[j]), lanes_set(a->high[j]));
    LOOP_AXIS(0, gap, lanes3_row(s->axes[j]));
  }
  // a's slab: heights of b's boxes, which are in its own axes
  const float *n = a->normal;
  const lanes from = (n[0] > 0 ? b->low[0] : b->high[0]) * n[0] +
                     (n[1] > 0 ? b->low[1] : b->high[1]) * n[1] +
                     (n[2] > 0 ? b->low[2] : b->high[2]) * n[2];
  const lanes to = (n[0] > 0 ? b->high[0] : b->low[0]) * n[0] +
                   (n[1] > 0 ? b->high[1] : b->low[1]) * n[1] +
                   (n[2] > 0 ? b->high[2] : b->low[2]) * n[2];
  gap = wider(gap, from, to, lanes_set(a->slab_low), lanes_set(a->slab_high));
  LOOP_AXIS(0, gap, lanes3_row(n));
  *gaps = gap;
  if (!(b->there & ~lanes_above(gap, lanes_set(0))))
    return 0;
  const float *h = a->half;
  const float *p = a->start;
  const float *q = a->end;
  const lanes start = b->normal.x * p[0] + b->normal.y * p[1] + b->normal.z * p[2];
  const lanes end = b->normal.x * q[0] + b->normal.y * q[1] + b->normal.z * q[2];
  const lanes stray = b->along * (s->ea_w + s->eb_w * a->reach) +
                      b->across * (s->ea + s->eb * a->reach) + s->rounding;
  const lanes start_by =
      b->by_start.x * h[0] + b->by_start.y * h[1] + b->by_start.z * h[2] + stray;
  const lanes end_by = b->by_end.x * h[0] + b->by_end.y * h[1] + b->by_end.z * h[2] + stray;
  gap = wider(gap, b->slab_low, b->slab_high, lanes_min(start - start_by, end - end_by),
              lanes_max(start + start_by, end + end_by));
  LOOP_AXIS(0, gap, b->normal);
  *gaps = gap;
  return b->there & ~lanes_above(gap, lanes_set(0));
}

// a is along b's axes only, at first.
static uint32_t part_moving(const span *s, float scale, const tree_body *body, moving_children *a,
                            const tree_child *b, lanes *gaps) {
  const lanes zero = lanes_set(0);
  const float *c = b->centre;
  const float *h = b->half;
  lanes gap = lanes_set(-HUGE_VALF);
  for (int j = 0; j < 3; j++) {
    gap = wider(gap, a->low[j], a->high[j], lanes_set(c[j] - h[j]), lanes_set(c[j] + h[j]));
    LOOP_AXIS(0, gap, lanes3_row(s->axes[j]));
  }
  if (!(a->there & ~lanes_above(gap, zero)))
    return 0;
  if (!a->all)
    move_all(s, scale, body, a);
  for (int j = 3; j < 6; j++) {
    const float *n = s->axes[j];
    const float at = dot3(n, c);
    const float by = fabsf(n[0]) * h[0] + fabsf(n[1]) * h[1] + fabsf(n[2]) * h[2];
    gap = wider(gap, a->low[j], a->high[j], lanes_set(at - by), lanes_set(at + by));
    LOOP_AXIS(0, gap, lanes3_row(n));
  }
  const lanes at = lanes3_dot(a->normal, lanes3_set(c[0], c[1], c[2]));
  const lanes by = lanes3_dot(lanes3_abs(a->normal), lanes3_set(h[0], h[1], h[2]));
  gap = wider(gap, a->slab_low, a->slab_high, at - by, at + by);
  LOOP_AXIS(0, gap, a->normal);

  // b's slab
  const float *n = b->normal;
  float m[3];
  float e[3];
  turn_back(s->start, n, m);
  turn_back(s->end, n, e);
  const lanes stray = (stray_of(s, n, 0) + s->rounding) + stray_along_reach(s, n) * a->reach;
  const lanes start = n[0] * a->start.x + n[1] * a->start.y + n[2] * a->start.z;
  const lanes end = n[0] * a->end.x + n[1] * a->end.y + n[2] * a->end.z;
  const lanes start_by = fabsf(m[0]) * a->half.x + fabsf(m[1]) * a->half.y +
                         fabsf(m[2]) * a->half.z + stray;
  const lanes end_by = fabsf(e[0]) * a->half.x + fabsf(e[1]) * a->half.y +
                       fabsf(e[2]) * a->half.z + stray;
  gap = wider(gap, lanes_min(start - start_by, end - end_by),
              lanes_max(start + start_by, end + end_by), lanes_set(b->slab[0]),
              lanes_set(b->slab[1]));
  LOOP_AXIS(0, gap, lanes3_row(n));
  *gaps = gap;
  return a->there & ~lanes_above(gap, zero);
}

// ---- triangles

// A triangle of each body, in b's frame.
typedef struct couple_places {
  float start[3][3], end[3][3];  // of a's corners
  float rest[3][3];
} couple_places;

typedef struct couple_gaps {
  float all;         // over the span; rounding and quanta not yet taken off
  float start, end;  // at its ends only
} couple_gaps;

// Along 16 directions: edges crossed, edges' normals within either plane, corner to corner.
static couple_gaps part_couple(const span *s, const couple_places *p, float reach) {
  float edge[8][3];  // of a half way, of b; normals of a, of b
  lanes rows[3];
  lanes others[3];
  for (int k = 0; k < 3; k++) {
    for (int c = 0; c < 3; c++) {
      const int next = (c + 1) % 3;
      edge[c][k] = p->start[next][k] - p->start[c][k] + p->end[next][k] - p->end[c][k];
      edge[3 + c][k] = p->rest[next][k] - p->rest[c][k];
    }
  }
  for (int k = 0; k < 3; k++) {
    const int y = (k + 1) % 3;
    const int z = (k + 2) % 3;
    edge[6][k] = edge[0][y] * edge[1][z] - edge[0][z] * edge[1][y];
    edge[7][k] = edge[3][y] * edge[4][z] - edge[3][z] * edge[4][y];
  }
  // lanes 0-8: a's edges with b's; 9-11: b's normal with its edges; 12-14: a's with its own
  for (int k = 0; k < 3; k++) {
    lanes u = lanes_set(edge[0][k]);
    u = lanes_pick(0x0038, lanes_set(edge[1][k]), u);
    u = lanes_pick(0x01c0, lanes_set(edge[2][k]), u);
    u = lanes_pick(0x0e00, lanes_set(edge[7][k]), u);
    rows[k] = lanes_pick(0x7000, lanes_set(edge[6][k]), u);
    lanes v = lanes_set(edge[3][k]);
    v = lanes_pick(0x0492, lanes_set(edge[4][k]), v);
    v = lanes_pick(0x0924, lanes_set(edge[5][k]), v);
    v = lanes_pick(0x1000, lanes_set(edge[0][k]), v);
    v = lanes_pick(0x2000, lanes_set(edge[1][k]), v);
    others[k] = lanes_pick(0x4000, lanes_set(edge[2][k]), v);
  }
  const lanes3 u = {rows[0], rows[1], rows[2]};
  const lanes3 v = {others[0], others[1], others[2]};
  lanes3 n = lanes3_cross(u, v);
  const uint32_t last = 1u << 15;  // from corner to corner
  n.x = lanes_pick(last, lanes_set(p->start[0][0] + p->end[0][0] - 2 * p->rest[0][0]), n.x);
  n.y = lanes_pick(last, lanes_set(p->start[0][1] + p->end[0][1] - 2 * p->rest[0][1]), n.y);
  n.z = lanes_pick(last, lanes_set(p->start[0][2] + p->end[0][2] - 2 * p->rest[0][2]), n.z);
  n = lanes3_unit(n);
  lanes low[3];
  lanes high[3];
  for (int c = 0; c < 3; c++) {
    const lanes start = n.x * p->start[c][0] + n.y * p->start[c][1] + n.z * p->start[c][2];
    const lanes end = n.x * p->end[c][0] + n.y * p->end[c][1] + n.z * p->end[c][2];
    const lanes rest = n.x * p->rest[c][0] + n.y * p->rest[c][1] + n.z * p->rest[c][2];
    low[0] = c ? lanes_min(low[0], start) : start;
    high[0] = c ? lanes_max(high[0], start) : start;
    low[1] = c ? lanes_min(low[1], end) : end;
    high[1] = c ? lanes_max(high[1], end) : end;
    low[2] = c ? lanes_min(low[2], rest) : rest;
    high[2] = c ? lanes_max(high[2], rest) : rest;
  }
  couple_gaps gaps;
  const lanes below_start = low[2] - high[0];
  const lanes above_start = low[0] - high[2];
  const lanes below_end = low[2] - high[1];
  const lanes above_end = low[1] - high[2];
  gaps.start = lanes_most(lanes_max(below_start, above_start));
  gaps.end = lanes_most(lanes_max(below_end, above_end));
  const lanes all = lanes_max(lanes_min(below_start, below_end), lanes_min(above_start, above_end)) -
                    stray_along(s, n, reach);
  gaps.all = lanes_most(all);
  LOOP_AXIS(0, all, n);
  return gaps;
}

// 16 triangles with the boxes over all that they are given.
typedef struct triangles {
  lanes3 corner[3];
  lanes3 low, high;
} triangles;

FAST void bound_triangles(triangles *t) {
  t->low.x = lanes_min(t->corner[0].x, lanes_min(t->corner[1].x, t->corner[2].x));
  t->low.y = lanes_min(t->corner[0].y, lanes_min(t->corner[1].y, t->corner[2].y));
  t->low.z = lanes_min(t->corner[0].z, lanes_min(t->corner[1].z, t->corner[2].z));
  t->high.x = lanes_max(t->corner[0].x, lanes_max(t->corner[1].x, t->corner[2].x));
  t->high.y = lanes_max(t->corner[0].y, lanes_max(t->corner[1].y, t->corner[2].y));
  t->high.z = lanes_max(t->corner[0].z, lanes_max(t->corner[1].z, t->corner[2].z));
}
FAST lanes3 face_normals(const lanes3 *corner) {
  return lanes3_unit(lanes3_cross(lanes3_sub(corner[1], corner[0]), lanes3_sub(corner[2], corner[0])));
}

#endif
