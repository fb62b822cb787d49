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

#include "motion.h"

FAST float less(float a, float b) {
  return a < b ? a : b;
}
FAST float more(float a, float b) {
  return a > b ? a : b;
}

// A child of a as it moves in a span.
typedef struct moving_child {
  tree_child child;
  float stray;               // in any direction
  float way;                 // of its centre
  float start[3], end[3];    // its centre
  lanes low, high;           // along the span's axes, stray taken off and added
  int has_slab;               // what follows is known
  float normal[3];            // its slab's, half way, in b's frame
  float slab_low, slab_high;  // as low and high
} moving_child;

// A child of b.
typedef struct resting_child {
  tree_child child;
  lanes low, high;
} resting_child;

// ---- one child of each

static void move_child(span *s, const tree_child *c, moving_child *out) {
  if (!s->has_axes)
    span_axes(s);
  const lanes3 centre = lanes3_set(c->centre[0], c->centre[1], c->centre[2]);
  const lanes3 half = lanes3_set(c->half[0], c->half[1], c->half[2]);
  const lanes stray = s->axes_ea + s->axes_eb * c->reach;
  const lanes at_start = lanes3_dot(s->at_start, centre) + s->start_height;
  const lanes at_end = lanes3_dot(s->at_end, centre) + s->end_height;
  const lanes by_start = lanes3_dot(lanes3_abs(s->at_start), half) + stray;
  const lanes by_end = lanes3_dot(lanes3_abs(s->at_end), half) + stray;
  out->low = lanes_min(at_start - by_start, at_end - by_end);
  out->high = lanes_max(at_start + by_start, at_end + by_end);
  out->child = *c;
  out->stray = s->ea + s->eb * c->reach + s->rounding;
  out->has_slab = 0;
  float square = 0;
  for (int k = 0; k < 3; k++) {  // b's axes are the first of the span's
    out->start[k] = at_start[k];
    out->end[k] = at_end[k];
    square += (at_end[k] - at_start[k]) * (at_end[k] - at_start[k]);
  }
  out->way = sqrtf(square);
}

// Its slab, as it moves.
static void move_slab(const span *s, float scale, moving_child *out) {
  const tree_child *c = &out->child;
  float *n = out->normal;
  float length = 0;
  for (int k = 0; k < 3; k++) {
    n[k] = s->half_way[k] * c->normal[0] + s->half_way[3 + k] * c->normal[1] +
           s->half_way[6 + k] * c->normal[2];
    length += n[k] * n[k];
  }
  const float unit = length > 1e-12f ? 0.999999f / sqrtf(length) : 0;
  for (int k = 0; k < 3; k++)
    n[k] *= unit;
  float start_low = scale * c->slab[0];
  float start_high = scale * c->slab[1];
  float end_low = start_low;
  float end_high = start_high;
  for (int k = 0; k < 3; k++) {
    const float v = scale * c->normal[k];
    const float by_start = s->start[k] * n[0] + s->start[3 + k] * n[1] + s->start[6 + k] * n[2] - v;
    const float by_end = s->end[k] * n[0] + s->end[3 + k] * n[1] + s->end[6 + k] * n[2] - v;
    const float mean_start = n[k] * s->start_at[k] + by_start * c->centre[k];
    const float mean_end = n[k] * s->end_at[k] + by_end * c->centre[k];
    start_low += mean_start - fabsf(by_start) * c->half[k];
    start_high += mean_start + fabsf(by_start) * c->half[k];
    end_low += mean_end - fabsf(by_end) * c->half[k];
    end_high += mean_end + fabsf(by_end) * c->half[k];
  }
  const float along = stray_of(s, n, c->reach) + s->rounding;
  out->slab_low = less(start_low, end_low) - along;
  out->slab_high = more(start_high, end_high) + along;
  out->has_slab = 1;
}

static resting_child rest_child(const span *s, const tree_child *c) {
  resting_child out;
  const lanes3 half = lanes3_set(c->half[0], c->half[1], c->half[2]);
  const lanes at = lanes3_dot(s->axes, lanes3_set(c->centre[0], c->centre[1], c->centre[2]));
  const lanes by = lanes3_dot(lanes3_abs(s->axes), half);
  out.child = *c;
  out.low = at - by;
  out.high = at + by;
  return out;
}

// A box along n, and about where: heights of its lowest and highest points, for single ones.
FAST void box_along(const tree_child *c, const float *n, float *low, float *high) {
  float at = 0;
  float by = 0;
  for (int k = 0; k < 3; k++) {
    at += n[k] * c->centre[k];
    by += fabsf(n[k]) * c->half[k];
  }
  *low = at - by;
  *high = at + by;
}

// The gap of two boxes: 16 axes, and both slabs.
static float pair_gap(const span *s, float scale, moving_child *a, const resting_child *b) {
  float low;
  float high;
  float gap = lanes_most(lanes_max(b->low - a->high, a->low - b->high));
  if (gap > 0)
    return gap;
  if (!a->has_slab)
    move_slab(s, scale, a);
  box_along(&b->child, a->normal, &low, &high);
  gap = more(gap, more(low - a->slab_high, a->slab_low - high));
  const float *n = b->child.normal;
  float at_start = 0;
  float at_end = 0;
  float by_start = 0;
  float by_end = 0;
  for (int k = 0; k < 3; k++) {
    const float m = s->start[k] * n[0] + s->start[3 + k] * n[1] + s->start[6 + k] * n[2];
    const float e = s->end[k] * n[0] + s->end[3 + k] * n[1] + s->end[6 + k] * n[2];
    at_start += n[k] * a->start[k];
    at_end += n[k] * a->end[k];
    by_start += fabsf(m) * a->child.half[k];
    by_end += fabsf(e) * a->child.half[k];
  }
  const float stray = stray_of(s, n, a->child.reach) + s->rounding;
  const float least = less(at_start - by_start, at_end - by_end) - stray;
  const float most = more(at_start + by_start, at_end + by_end) + stray;
  return more(gap, more(b->child.slab[0] - most, least - b->child.slab[1]));
}

// ---- one child of one tree and 16 of the other. Both return the lanes that still meet.

// The widest of the intervals' gaps so far.
FAST lanes wider(lanes gap, lanes low, lanes high, lanes other_low, lanes other_high) {
  return lanes_max(gap, lanes_max(low - other_high, other_low - high));
}

static uint32_t part_resting(const span *s, float scale, moving_child *a, const tree_children *b,
                             lanes *gaps) {
  const lanes zero = lanes_set(0);
  lanes gap = lanes_max(b->low.x - a->high[0], a->low[0] - b->high.x);
  gap = wider(gap, b->low.y, b->high.y, lanes_set(a->low[1]), lanes_set(a->high[1]));
  gap = wider(gap, b->low.z, b->high.z, lanes_set(a->low[2]), lanes_set(a->high[2]));
  *gaps = gap;
  if (!(b->there & ~lanes_above(gap, zero)))
    return 0;
  const lanes3 centre = lanes3_scale(lanes3_add(b->low, b->high), lanes_set(0.5f));
  const lanes3 half = lanes3_scale(lanes3_sub(b->high, b->low), lanes_set(0.5f));
  for (int j = 0; j < 3; j++) {
    const float *n = s->half_way + 3 * j;
    const lanes at = n[0] * centre.x + n[1] * centre.y + n[2] * centre.z;
    const lanes by = fabsf(n[0]) * half.x + fabsf(n[1]) * half.y + fabsf(n[2]) * half.z;
    gap = wider(gap, at - by, at + by, lanes_set(a->low[3 + j]), lanes_set(a->high[3 + j]));
  }
  if (!a->has_slab)
    move_slab(s, scale, a);
  const float *n = a->normal;
  const lanes at = n[0] * centre.x + n[1] * centre.y + n[2] * centre.z;
  const lanes by = fabsf(n[0]) * half.x + fabsf(n[1]) * half.y + fabsf(n[2]) * half.z;
  gap = wider(gap, at - by, at + by, lanes_set(a->slab_low), lanes_set(a->slab_high));
  *gaps = gap;
  if (!(b->there & ~lanes_above(gap, zero)))
    return 0;

  const float *h = a->child.half;
  const lanes3 by_start = lanes3_abs(lanes3_turn_back(s->start, b->normal));
  const lanes3 by_end = lanes3_abs(lanes3_turn_back(s->end, b->normal));
  const lanes start = lanes3_dot(b->normal, lanes3_set(a->start[0], a->start[1], a->start[2]));
  const lanes end = lanes3_dot(b->normal, lanes3_set(a->end[0], a->end[1], a->end[2]));
  const lanes stray = stray_along(s, b->normal, a->child.reach) + s->rounding;
  const lanes start_by = by_start.x * h[0] + by_start.y * h[1] + by_start.z * h[2] + stray;
  const lanes end_by = by_end.x * h[0] + by_end.y * h[1] + by_end.z * h[2] + stray;
  gap = wider(gap, b->slab_low, b->slab_high, lanes_min(start - start_by, end - end_by),
              lanes_max(start + start_by, end + end_by));
  *gaps = gap;
  return b->there & ~lanes_above(gap, zero);
}

// Heights of 16 moving boxes along n: m, e: n as a sees it at the start and the end; p, q: of a's
// middle then.
FAST lanes boxes_along(lanes gap, lanes3 centre, lanes3 half, lanes stray, const float *m, float p,
                       const float *e, float q, float low, float high) {
  const lanes start = m[0] * centre.x + m[1] * centre.y + m[2] * centre.z + p;
  const lanes end = e[0] * centre.x + e[1] * centre.y + e[2] * centre.z + q;
  const lanes start_by =
      fabsf(m[0]) * half.x + fabsf(m[1]) * half.y + fabsf(m[2]) * half.z + stray;
  const lanes end_by = fabsf(e[0]) * half.x + fabsf(e[1]) * half.y + fabsf(e[2]) * half.z + stray;
  return wider(gap, lanes_min(start - start_by, end - end_by),
               lanes_max(start + start_by, end + end_by), lanes_set(low), lanes_set(high));
}

static uint32_t part_moving(const span *s, float scale, const tree_children *a,
                            const resting_child *b, lanes *gaps) {
  const lanes zero = lanes_set(0);
  const lanes3 centre = lanes3_scale(lanes3_add(a->low, a->high), lanes_set(0.5f));
  const lanes3 half = lanes3_scale(lanes3_sub(a->high, a->low), lanes_set(0.5f));
  lanes gap = lanes_set(-HUGE_VALF);
  for (int i = 0; i < 6; i++) {  // b's faces are rows of the poses
    const float m[3] = {s->at_start.x[i], s->at_start.y[i], s->at_start.z[i]};
    const float e[3] = {s->at_end.x[i], s->at_end.y[i], s->at_end.z[i]};
    const lanes stray = s->axes_ea[i] + s->axes_eb[i] * a->reach;
    gap = boxes_along(gap, centre, half, stray, m, s->start_height[i], e, s->end_height[i],
                      b->low[i], b->high[i]);
    if (i == 2 && !(a->there & ~lanes_above(gap, zero)))
      return 0;
  }
  const float *n = b->child.normal;
  float m[3];
  float e[3];
  float p = 0;
  float q = 0;
  for (int k = 0; k < 3; k++) {
    m[k] = s->start[k] * n[0] + s->start[3 + k] * n[1] + s->start[6 + k] * n[2];
    e[k] = s->end[k] * n[0] + s->end[3 + k] * n[1] + s->end[6 + k] * n[2];
    p += n[k] * s->start_at[k];
    q += n[k] * s->end_at[k];
  }
  const float ea = stray_of(s, n, 0);
  const float eb = stray_of(s, n, 1) - ea + 1e-6f * (s->eb + ea);
  const lanes stray_b = (ea + s->rounding) + eb * a->reach;
  gap = boxes_along(gap, centre, half, stray_b, m, p, e, q, b->child.slab[0], b->child.slab[1]);
  *gaps = gap;
  if (!(a->there & ~lanes_above(gap, zero)))
    return 0;

  // a's slabs, half way
  const lanes3 normal = lanes3_unit(lanes3_turn_back(s->half_way, a->normal));
  const lanes3 turned = lanes3_scale(a->normal, lanes_set(scale));
  const lanes3 by_start = lanes3_sub(lanes3_turn_back(s->start, normal), turned);
  const lanes3 by_end = lanes3_sub(lanes3_turn_back(s->end, normal), turned);
  const lanes start = lanes3_dot(normal, lanes3_set(s->start_at[0], s->start_at[1], s->start_at[2])) +
                      lanes3_dot(by_start, centre);
  const lanes end = lanes3_dot(normal, lanes3_set(s->end_at[0], s->end_at[1], s->end_at[2])) +
                    lanes3_dot(by_end, centre);
  const lanes along = lanes_abs(normal.x * s->w[0] + normal.y * s->w[1] + normal.z * s->w[2]);
  const lanes across = lanes_sqrt(lanes_max(1.000004f - along * along, zero));
  const lanes stray = along * (s->ea_w + s->eb_w * a->reach) +
                      across * (s->ea + s->eb * a->reach) + s->rounding;
  const lanes start_by = lanes3_dot(lanes3_abs(by_start), half) + stray;
  const lanes end_by = lanes3_dot(lanes3_abs(by_end), half) + stray;
  const lanes low = lanes_min(start - start_by, end - end_by) + scale * a->slab_low;
  const lanes high = lanes_max(start + start_by, end + end_by) + scale * a->slab_high;
  const float *c = b->child.centre;
  const float *h = b->child.half;
  const lanes at = lanes3_dot(normal, lanes3_set(c[0], c[1], c[2]));
  const lanes by = lanes3_dot(lanes3_abs(normal), lanes3_set(h[0], h[1], h[2]));
  gap = wider(gap, low, high, at - by, at + by);
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
  gaps.all = lanes_most(lanes_max(lanes_min(below_start, below_end), lanes_min(above_start, above_end)) -
                        stray_along(s, n, reach));
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
