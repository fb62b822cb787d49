// In: the corners of a face. Out: triangles, by ear clipping (Meisters 1975; after Eberly,
// "Triangulation by Ear Clipping").
//
// A face of n corners becomes n - 2 triangles, whose vector areas sum to the polygon's. A simple
// polygon, concave or with holes joined to the outline by bridges, is covered without overlap; any
// other (one that crosses itself or has no area) is cut somehow.
//
// An ear is a convex corner whose triangle contains no reflex corner. Difference from Eberly: that
// test visits boxes, not all reflex corners, so that faces may have many corners. The corners are
// sorted along a Z curve (Morton 1966); each run of 8 has a box, each two neighbouring boxes have
// one about them, and so on up to one about all.
#pragma once
#include "../ground/memory.h"
#include "../ground/slices.h"

#ifndef NSVCD_NO_READERS
#define NSVCD__RUN 8

// A point in the polygon's plane.
typedef struct nsvcd__d2 {
  double x, y;
} nsvcd__d2;

typedef struct nsvcd__corner {
  // the polygon is counter-clockwise
  nsvcd__d2 at;
  uint32_t vertex;
  // in the ring of corners not yet clipped
  uint32_t previous, next;
  uint32_t queued;  // 1: in the queue
  // 1: the inner angle exceeds 180 degrees
  uint32_t reflex;
  uint32_t box;  // of its run
} nsvcd__corner;

typedef struct nsvcd__corner_box {
  nsvcd__d2 low, high;
  // how many reflex corners are in it
  uint32_t reflex;
} nsvcd__corner_box;

typedef struct nsvcd__polygon {
  nsvcd__corner *corners;
  // (count) corners along the Z curve
  uint32_t *order;
  // (2 runs) box k is about boxes 2 k and 2 k + 1; the last `runs` are those of the runs
  nsvcd__corner_box *boxes;
  // runs: a power of two
  uint32_t count, runs;
  // (count) a ring buffer: corners that may have become ears
  uint32_t *queue;
  uint32_t queue_first, queue_length;
} nsvcd__polygon;

// The number of runs, rounded up to a power of two.
static uint32_t nsvcd__runs_of(uint32_t corners) {
  uint32_t runs = 1;
  while (NSVCD__RUN * (uint64_t)runs < corners) runs *= 2;
  return runs;
}

// Makes room for polygons of up to `corners` corners. 0 without memory.
static int nsvcd__polygon_alloc(nsvcd__polygon *poly, uint32_t corners, nsvcd__arena *arena) {
  memset(poly, 0, sizeof *poly);
  poly->corners = NSVCD__TAKE(arena, nsvcd__corner, corners);
  poly->order = NSVCD__TAKE(arena, uint32_t, corners);
  poly->queue = NSVCD__TAKE(arena, uint32_t, corners);
  poly->boxes = NSVCD__TAKE(arena, nsvcd__corner_box, 2 * (size_t)nsvcd__runs_of(corners));
  return !arena->failed;
}

// Twice the area of abc, positive if counter-clockwise. Differences of floats are next to exact in
// double.
static double nsvcd__d2_cross(nsvcd__d2 a, nsvcd__d2 b, nsvcd__d2 c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}
static int nsvcd__same_position(nsvcd__d2 a, nsvcd__d2 b) {
  return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y);
}

// Projects the corners along the axis nearest to the normal, which keeps coordinates exact.
static void nsvcd__polygon_project(nsvcd__polygon *poly, const float *positions) {
  nsvcd__corner *corners = poly->corners;
  // twice the area times the normal (Newell's)
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  const nsvcd__d3 origin = nsvcd__d3_row(positions, corners[0].vertex);
  for (uint32_t i = 0; i < poly->count; i++) {
    const uint32_t next = corners[(i + 1) % poly->count].vertex;
    const nsvcd__d3 p = nsvcd__d3_sub(nsvcd__d3_row(positions, corners[i].vertex), origin);
    const nsvcd__d3 q = nsvcd__d3_sub(nsvcd__d3_row(positions, next), origin);
    normal = nsvcd__d3_add(normal, nsvcd__d3_cross(p, q));
  }
  const nsvcd__d3 size = {fabs(normal.x), fabs(normal.y), fabs(normal.z)};
  const size_t axis = nsvcd__d3_longest(size);
  const size_t turned = nsvcd__d3_axis(normal, axis) < 0;
  for (uint32_t i = 0; i < poly->count; i++) {
    const float *p = positions + 3 * (size_t)corners[i].vertex;
    corners[i].at.x = (double)p[(axis + 1 + turned) % 3];
    corners[i].at.y = (double)p[(axis + 2 - turned) % 3];
  }
}

// Sorts corners along the Z curve by this bit of their keys and those below: x and y take turns.
static void nsvcd__z_sort(const nsvcd__corner *corners, uint32_t *order, uint32_t count,
                          int bit) {
  if (count <= NSVCD__RUN || bit < 0) return;
  // the first that has the bit
  uint32_t ones = count;
  for (uint32_t i = 0; i < ones;) {
    const uint32_t corner = order[i];
    const nsvcd__d2 at = corners[corner].at;
    const float x = (float)(bit % 2 ? at.x : at.y);
    uint32_t key;
    memcpy(&key, &x, sizeof key);
    // grows with the coordinate
    key = key >> 31 ? ~key : key | 0x80000000u;
    if (key >> bit / 2 & 1) {
      order[i] = order[--ones];
      order[ones] = corner;
    } else {
      i++;
    }
  }
  nsvcd__z_sort(corners, order, ones, bit - 1);
  nsvcd__z_sort(corners, order + ones, count - ones, bit - 1);
}

// Contains nothing. tcc has no HUGE_VAL in constants.
#define NSVCD__NO_BOX \
  { {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0 }

static void nsvcd__box_take(nsvcd__corner_box *box, nsvcd__d2 at) {
  if (at.x < box->low.x) box->low.x = at.x;
  if (at.y < box->low.y) box->low.y = at.y;
  if (at.x > box->high.x) box->high.x = at.x;
  if (at.y > box->high.y) box->high.y = at.y;
}

// Makes the boxes. No corner counts as reflex yet.
static void nsvcd__polygon_box(nsvcd__polygon *poly) {
  poly->runs = nsvcd__runs_of(poly->count);
  const nsvcd__corner_box none = NSVCD__NO_BOX;
  for (uint32_t k = 0; k < 2 * poly->runs; k++) poly->boxes[k] = none;
  for (uint32_t i = 0; i < poly->count; i++) poly->order[i] = i;
  nsvcd__z_sort(poly->corners, poly->order, poly->count, 63);
  for (uint32_t i = 0; i < poly->count; i++) {
    nsvcd__corner *c = &poly->corners[poly->order[i]];
    c->box = poly->runs + i / NSVCD__RUN;
    for (uint32_t k = c->box; k > 0; k /= 2) nsvcd__box_take(&poly->boxes[k], c->at);
  }
}

static void nsvcd__polygon_set_reflex(nsvcd__polygon *poly, uint32_t i, uint32_t reflex) {
  nsvcd__corner *c = &poly->corners[i];
  for (uint32_t k = c->box; k > 0 && c->reflex != reflex; k /= 2)
    poly->boxes[k].reflex += reflex - c->reflex;
  c->reflex = reflex;
}

// Updates corner i after a neighbour of it has changed.
static void nsvcd__polygon_update(nsvcd__polygon *poly, uint32_t i) {
  nsvcd__corner *corners = poly->corners;
  nsvcd__corner *c = &corners[i];
  const nsvcd__d2 previous = corners[c->previous].at;
  const nsvcd__d2 next = corners[c->next].at;
  nsvcd__polygon_set_reflex(poly, i, nsvcd__d2_cross(previous, c->at, next) < 0);
  if (c->queued) return;
  c->queued = 1;
  poly->queue[(poly->queue_first + poly->queue_length++) % poly->count] = i;
}

// A triangle of three neighbours, counter-clockwise, and the box about it.
typedef struct nsvcd__ear {
  nsvcd__d2 at[3];
  nsvcd__corner_box box;
} nsvcd__ear;

// Does an ear contain a point that is not at one of its corners?
static int nsvcd__ear_holds(const nsvcd__ear *ear, nsvcd__d2 p) {
  for (size_t k = 0; k < 3; k++) {
    if (nsvcd__d2_cross(ear->at[k], ear->at[(k + 1) % 3], p) < 0) return 0;
  }
  if (nsvcd__same_position(p, ear->at[0]) || nsvcd__same_position(p, ear->at[1])) return 0;
  return !nsvcd__same_position(p, ear->at[2]);
}

// May an ear contain a corner in a box?
static int nsvcd__ear_meets(const nsvcd__ear *ear, const nsvcd__corner_box *box) {
  if (nsvcd__same_position(box->low, box->high)) return nsvcd__ear_holds(ear, box->low);
  if (ear->box.high.x < box->low.x || ear->box.high.y < box->low.y) return 0;
  if (ear->box.low.x > box->high.x || ear->box.low.y > box->high.y) return 0;
  for (size_t k = 0; k < 3; k++) {
    // if the leftmost corner of the box is to the right of a side, all of it is
    const nsvcd__d2 a = ear->at[k];
    const nsvcd__d2 b = ear->at[(k + 1) % 3];
    const double x = b.y > a.y ? box->low.x : box->high.x;
    const nsvcd__d2 left = {x, b.x > a.x ? box->high.y : box->low.y};
    if (nsvcd__d2_cross(a, b, left) < 0) return 0;
  }
  return 1;
}

// Is corner i an ear? Only reflex corners can be in its triangle.
static int nsvcd__polygon_is_ear(const nsvcd__polygon *poly, uint32_t i) {
  const nsvcd__corner *corners = poly->corners;
  const nsvcd__d2 a = corners[corners[i].previous].at;
  const nsvcd__d2 c = corners[corners[i].next].at;
  nsvcd__ear ear = {{a, corners[i].at, c}, NSVCD__NO_BOX};
  if (nsvcd__d2_cross(a, ear.at[1], c) <= 0) return 0;
  for (size_t k = 0; k < 3; k++) nsvcd__box_take(&ear.box, ear.at[k]);
  for (uint32_t k = 1; k > 0;) {
    const nsvcd__corner_box *box = &poly->boxes[k];
    const int meets = box->reflex > 0 && nsvcd__ear_meets(&ear, box);
    if (meets && k < poly->runs) {
      k *= 2;
      continue;
    }
    const uint32_t first = NSVCD__RUN * (k - poly->runs);
    for (uint32_t j = first; meets && j < first + NSVCD__RUN && j < poly->count; j++) {
      const nsvcd__corner *p = &corners[poly->order[j]];
      if (p->reflex && nsvcd__ear_holds(&ear, p->at)) return 0;
    }
    // the next box that is not part of this one; 0: none is left
    while (k % 2) k /= 2;
    k += k > 0;
  }
  return 1;
}

// Writes triangles (count - 2, 3). poly: 3 or more corners, whose vertices are set.
static void nsvcd__polygon_triangulate(nsvcd__polygon *poly, const float *positions,
                                       uint32_t *triangles) {
  nsvcd__corner *corners = poly->corners;
  const uint32_t count = poly->count;
  poly->queue_first = 0;
  poly->queue_length = 0;
  for (uint32_t i = 0; i < count; i++) {
    corners[i].previous = (i + count - 1) % count;
    corners[i].next = (i + 1) % count;
    corners[i].queued = 0;
    corners[i].reflex = 0;
  }
  if (count > 3) {
    nsvcd__polygon_project(poly, positions);
    nsvcd__polygon_box(poly);
    for (uint32_t i = 0; i < count; i++) nsvcd__polygon_update(poly, i);
  }

  // a corner that is left
  uint32_t at = 0;
  for (uint32_t left = count; left > 3;) {
    // With an empty queue no corner is an ear, and the polygon is not simple: clip any corner.
    const int stuck = poly->queue_length == 0;
    const uint32_t i = stuck ? at : poly->queue[poly->queue_first];
    nsvcd__corner *c = &corners[i];
    if (!stuck) {
      poly->queue_first = (poly->queue_first + 1) % count;
      poly->queue_length--;
      c->queued = 0;
    }
    if (!stuck && !nsvcd__polygon_is_ear(poly, i)) continue;
    triangles[0] = corners[c->previous].vertex;
    triangles[1] = c->vertex;
    triangles[2] = corners[c->next].vertex;
    triangles += 3;
    left--;
    corners[c->previous].next = c->next;
    corners[c->next].previous = c->previous;
    nsvcd__polygon_set_reflex(poly, i, 0);
    nsvcd__polygon_update(poly, c->previous);
    nsvcd__polygon_update(poly, c->next);
    at = c->next;
  }
  triangles[0] = corners[at].vertex;
  triangles[1] = corners[corners[at].next].vertex;
  triangles[2] = corners[corners[at].previous].vertex;
}
#endif  // NSVCD_NO_READERS
