// convex.h - a rival for the benchmark: a few convex parts per mesh, and GJK between the
// parts of two bodies.
//
// In:  a mesh, closed or nearly so (what a gap wider than 1/60 of it lets drain is taken for a thin
//      shell).
//      preparation.points: the most parts, at most CONVEX_PARTS; 0: CONVEX_DEFAULT_PARTS.
//      preparation.detail: the depth at which a part is convex enough, as a share of the mesh's
//      largest extent: how far the surface lies below that of the part's hull, at worst; 0:
//      CONVEX_DEFAULT_DETAIL.
// Out: whether two bodies, as unions of convex hulls, come nearer than the activation distance at
//      one of the placements. A negative one asks for an overlap deeper than that, of one pair of
//      parts.
//
// Parts: the solid is cut by axis-aligned planes, each time the worst part, where the hulls of both
// sides hold the least space beside the solid (V-HACD: Mamou and Ghorbel 2009); how bad a part is,
// is a depth, as in CoACD (Wei et al. 2022). Cells serve to choose the plane only. The planes of
// the grid lie on the mesh's own wherever it has some, and a hull is that of the mesh's surface cut
// to its part: hulls of at most CONVEX_VERTICES corners, those that matter most. Query: boxes of
// bodies and of parts, the last axis that separated a pair, then GJK (Gilbert, Johnson, Keerthi
// 1988), or for overlaps Minkowski portal refinement (Snethen 2008), both libccd's.
#ifndef NSVCD_BENCH_CONVEX_H
#define NSVCD_BENCH_CONVEX_H

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "method.h"

#ifdef HAVE_LIBCCD  // else there is no convex_method
#include <ccd/ccd.h>

#define CONVEX_PARTS 64
#define CONVEX_DEFAULT_PARTS 32
#define CONVEX_DEFAULT_DETAIL 0.02f
#define CONVEX_VERTICES 256  // of a hull
#define CONVEX_STRAY 6.5     // what a hull may leave out, grid units: 5e-5 of the extent
// vertices are padded to a multiple of this, so that loops over them run in vectors
#define CONVEX_LANES 16
#define CONVEX_CELLS 60  // of the grid along the longest side, about
#define CONVEX_LINES (2 * CONVEX_CELLS + 8)
#define CONVEX_FACES 2048    // of a hull while it grows
#define CONVEX_BALANCE 0.02  // of a cut, against volume won

// ------------------------------------------------------------------------------------- convex hull
// Preparation works on a grid of whole numbers below 2^16: there all of a hull's signs are exact in
// double (a plane times a point stays below 2^53), so that coplanar points need no tolerance.

#define CONVEX_RANGE 65000.0

typedef struct convex_points {
  double (*at)[3];
  size_t count, capacity;
  int failed;  // no memory
} convex_points;

static void convex_add(convex_points *p, double x, double y, double z) {
  if (p->count == p->capacity) {
    size_t capacity = p->capacity ? 2 * p->capacity : 4096;
    double(*grown)[3] = (double(*)[3])realloc(p->at, capacity * sizeof *grown);
    if (!grown) {
      p->failed = 1;
      return;
    }
    p->at = grown;
    p->capacity = capacity;
  }
  double *q = p->at[p->count++];
  q[0] = x;
  q[1] = y;
  q[2] = z;
}

typedef struct convex_hull {
  // normals, outward, of twice the face's area
  double x[CONVEX_FACES], y[CONVEX_FACES], z[CONVEX_FACES];
  double offset[CONVEX_FACES];  // normal * corner; of a free slot 1
  double length[CONVEX_FACES];  // of the normal; 0: a free slot
  // of the point being added, times the normal's length
  double height[CONVEX_FACES];
  size_t corner[CONVEX_FACES][3];  // counter-clockwise from outside
  // the face beyond the edge from corner k to corner k + 1
  size_t across[CONVEX_FACES][3];
  size_t unused[CONVEX_FACES];  // slots free
  // of the last point: faces it is above, faces it made
  size_t seen[CONVEX_FACES], fresh[CONVEX_FACES];
  size_t slots, unused_count, fresh_count;
  double volume;  // times 6
  const double (*points)[3];
  size_t *fan;  // (points): the fresh face whose edge to the rim begins at this point
} convex_hull;

// (b - a) x (c - a)
static void convex_cross(const double *a, const double *b, const double *c, double *out) {
  double u[3], v[3];
  for (int k = 0; k < 3; k++) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  out[0] = u[1] * v[2] - u[2] * v[1];
  out[1] = u[2] * v[0] - u[0] * v[2];
  out[2] = u[0] * v[1] - u[1] * v[0];
}
static double convex_dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static size_t convex_face(convex_hull *h, size_t a, size_t b, size_t c) {
  size_t f = h->unused_count ? h->unused[--h->unused_count] : h->slots++;
  double n[3];
  convex_cross(h->points[a], h->points[b], h->points[c], n);
  h->x[f] = n[0];
  h->y[f] = n[1];
  h->z[f] = n[2];
  h->offset[f] = convex_dot(n, h->points[a]);
  h->length[f] = sqrt(convex_dot(n, n));
  h->height[f] = 0;
  h->volume += h->offset[f];
  h->corner[f][0] = a;
  h->corner[f][1] = b;
  h->corner[f][2] = c;
  h->fresh[h->fresh_count++] = f;
  return f;
}
static void convex_drop(convex_hull *h, size_t f) {
  h->volume -= h->offset[f];
  h->x[f] = h->y[f] = h->z[f] = h->length[f] = 0;
  h->offset[f] = 1;
  h->unused[h->unused_count++] = f;
}

// The point of [first, last) farthest from the point, line or plane through the `known` ones. 0 if
// none is off it.
static int convex_extreme(convex_hull *h, size_t first, size_t last, size_t *tetra, int known) {
  const double *a = h->points[tetra[0]];
  const double *b = h->points[tetra[1]];
  const double *c = h->points[tetra[2]];
  double most = 0;
  double n[3];
  for (size_t i = first; i < last; i++) {
    const double *p = h->points[i];
    double d[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
    double far;
    if (known == 2) convex_cross(a, b, p, d);
    if (known == 3) {
      convex_cross(a, b, c, n);
      far = convex_dot(n, d);
      far *= far;
    } else {
      far = convex_dot(d, d);
    }
    if (far > most) {
      most = far;
      tetra[known] = i;
    }
  }
  return most > 0;
}
// A tetrahedron out of the points [first, last). 0 if they are all in one plane.
static int convex_start(convex_hull *h, size_t first, size_t last) {
  size_t t[4] = {first, first, first, first};
  h->slots = h->unused_count = h->fresh_count = 0;
  h->volume = 0;
  if (first == last) return 0;
  if (!convex_extreme(h, first, last, t, 1)) return 0;
  t[0] = t[1];
  for (int known = 1; known < 4; known++)
    if (!convex_extreme(h, first, last, t, known)) return 0;
  double n[3], d[3];
  convex_cross(h->points[t[0]], h->points[t[1]], h->points[t[2]], n);
  for (int k = 0; k < 3; k++) d[k] = h->points[t[3]][k] - h->points[t[0]][k];
  size_t swap = t[1];
  if (convex_dot(n, d) > 0) {
    t[1] = t[2];
    t[2] = swap;
  }
  convex_face(h, t[0], t[1], t[2]);
  convex_face(h, t[0], t[3], t[1]);
  convex_face(h, t[1], t[3], t[2]);
  convex_face(h, t[2], t[3], t[0]);
  for (size_t f = 0; f < 4; f++)
    for (size_t g = 0; g < 4; g++)
      for (size_t j = 0; j < 3; j++)
        for (size_t k = 0; k < 3; k++)
          if (h->corner[f][j] == h->corner[g][(k + 1) % 3] &&
              h->corner[g][k] == h->corner[f][(j + 1) % 3])
            h->across[f][j] = g;
  return 1;
}
// Adds point p: faces that it is strictly above give way to a fan about it. 0 if it is not outside
// the hull.
static int convex_insert(convex_hull *h, size_t p) {
  double x = h->points[p][0];
  double y = h->points[p][1];
  double z = h->points[p][2];
  size_t slots = h->slots;
  size_t above = 0;
  h->fresh_count = 0;
  for (size_t f = 0; f < slots; f++)
    h->height[f] = h->x[f] * x + h->y[f] * y + h->z[f] * z - h->offset[f];
  for (size_t f = 0; f < slots; f++) above += h->height[f] > 0;
  // full: only wildly round hulls
  if (!above || CONVEX_FACES - slots + h->unused_count < above + 2) return 0;
  for (size_t f = 0, n = 0; n < above; f++) {
    h->seen[n] = f;
    n += h->height[f] > 0;
  }
  for (size_t i = 0; i < above; i++) {
    for (size_t f = h->seen[i], k = 0; k < 3; k++) {
      size_t beyond = h->across[f][k];
      size_t a = h->corner[f][k];
      size_t b = h->corner[f][(k + 1) % 3];
      size_t j = 0;
      if (h->height[beyond] > 0) continue;
      size_t g = convex_face(h, a, b, p);
      while (h->corner[beyond][j] != b) j++;
      h->across[beyond][j] = g;
      h->across[g][0] = beyond;
      h->fan[a] = g;
    }
  }
  for (size_t i = 0; i < h->fresh_count; i++) {
    size_t f = h->fresh[i];
    size_t next = h->fan[h->corner[f][1]];
    h->across[f][1] = next;
    h->across[next][2] = f;
  }
  for (size_t i = 0; i < above; i++) convex_drop(h, h->seen[i]);
  return 1;
}

// The height of p over the face (or NULL: of all) that it is highest over, in grid units: negative
// inside.
static double convex_highest(const convex_hull *h, const size_t *faces, size_t count,
                             const double *p, size_t *which) {
  double best = -DBL_MAX;
  for (size_t i = 0; i < count; i++) {
    size_t f = faces ? faces[i] : i;
    double height = h->x[f] * p[0] + h->y[f] * p[1] + h->z[f] * p[2] - h->offset[f];
    if (h->length[f] > 0 && height > best * h->length[f]) {
      best = height / h->length[f];
      *which = f;
    }
  }
  return best;
}
// The hull of all points, up to `limit` of them, each time the one that sticks out farthest
// (quickhull: Barber et al. 1996). owner, out: (count), scratch. 0 if the points are all in one
// plane.
static int convex_wrap(convex_hull *h, size_t count, size_t limit, size_t *owner, double *out) {
  if (!convex_start(h, 0, count)) return 0;
  for (size_t i = 0; i < count; i++)
    out[i] = convex_highest(h, NULL, h->slots, h->points[i], &owner[i]);
  for (size_t n = 4; n < limit; n++) {
    size_t far = 0;
    for (size_t i = 1; i < count; i++)
      if (out[i] > out[far]) far = i;
    if (out[far] < CONVEX_STRAY) break;
    if (!convex_insert(h, far)) break;
    for (size_t i = 0; i < count; i++)
      if (out[i] > 0 && h->height[owner[i]] > 0)
        out[i] = convex_highest(h, h->fresh, h->fresh_count, h->points[i], &owner[i]);
    out[far] = 0;
  }
  return 1;
}

// ------------------------------------------------------------------------------------------- solid
// The mesh in cells of a grid whose planes lie on the mesh's own where many of its vertices share
// one.

enum { CONVEX_INSIDE = 0, CONVEX_OUTSIDE, CONVEX_SURFACE };

typedef struct convex_box {  // cells [first, last)
  size_t first[3], last[3];
} convex_box;

typedef struct convex_part {
  convex_box box;
  double depth;  // how far the surface lies below the hull, at most
  double corners[CONVEX_VERTICES][3];
  size_t count;
} convex_part;

typedef struct convex_work {  // everything in grid units but `center` and `unit`
  const nsvcd_mesh *mesh;
  double center[3], unit;  // metres = center + unit * grid
  double (*vertices)[3];   // (vertex_count)
  // (vertex_count): 0 in no triangle, else the last part that the vertex was gathered for
  uint32_t *stamps, stamp;
  double line[3][CONVEX_LINES];  // planes of the grid
  size_t size[3];                // cells
  unsigned char *cells;          // (size[0], size[1], size[2])
  // one point of the mesh in every surface cell, just below the surface
  convex_points surface;
  convex_points points;           // of the hull at hand
  size_t *owner, owner_capacity;  // scratch
  convex_hull hull;
  convex_part parts[CONVEX_PARTS];
  size_t part_count;
} convex_work;

static int convex_compare(const void *pa, const void *pb) {
  double a = *(const double *)pa;
  double b = *(const double *)pb;
  return (a > b) - (a < b);
}
// Planes of the grid along an axis: those that hold at least four vertices (the flat sides of the
// mesh), the fuller one where two are too near each other, and evenly spaced ones in the gaps.
// values: (count), scratch.
static void convex_lines(convex_work *w, size_t axis, double cell, double *values) {
  size_t count = 0;
  size_t n = 1;
  size_t weight = 0;
  size_t chosen = 1;
  size_t last = 0;
  double planes[CONVEX_LINES];
  double *line = w->line[axis];
  for (size_t i = 0; i < w->mesh->vertex_count; i++)
    if (w->stamps[i]) values[count++] = w->vertices[i][axis];
  qsort(values, count, sizeof *values, convex_compare);
  planes[0] = values[0];  // the outermost planes are always there
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i; end < count && values[end] - values[i] < 2;) end++;
    weight = end - i;
    if (weight < 4 || values[i] < planes[0] + cell / 2 || values[i] > values[count - 1] - cell / 2)
      continue;
    if (chosen > 1 && values[i] - planes[chosen - 1] < cell / 2) {
      if (weight > last) {
        planes[chosen - 1] = values[i];
        last = weight;
      }
    } else {
      planes[chosen++] = values[i];
      last = weight;
    }
  }
  planes[chosen++] = values[count - 1] > planes[0] + 2 ? values[count - 1] : planes[0] + 2;
  line[0] = floor(planes[0] - cell);
  for (size_t i = 0; i + 1 < chosen; i++) {
    double gap = planes[i + 1] - planes[i];
    double pieces = fmax(1, floor(gap / cell + 0.5));
    for (double k = 0; k < pieces; k++) line[n++] = floor(planes[i] + gap * k / pieces);
  }
  line[n] = planes[chosen - 1];
  line[n + 1] = ceil(planes[chosen - 1] + cell);
  w->size[axis] = n + 1;
}

static size_t convex_cell(const convex_work *w, size_t i, size_t j, size_t k) {
  return (i * w->size[1] + j) * w->size[2] + k;
}
static double convex_distance(const double *a, const double *b) {
  double x = a[0] - b[0];
  double y = a[1] - b[1];
  double z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}
// Marks the cells of a triangle, a b its shortest edge, by points at most `step` apart, off its
// edges and just below it: a face in a plane of the grid then counts on the solid's side only.
static void convex_mark(convex_work *w, const double *a, const double *b, const double *c,
                        double step) {
  double n[3], p[3];
  size_t at[3] = {0, 0, 0};
  convex_cross(a, b, c, n);
  double length = sqrt(convex_dot(n, n));
  double rows = floor(convex_distance(a, b) / step) + 2;
  for (int k = 0; k < 3; k++) n[k] *= length > 0 ? 1 / length : 0;
  for (double i = 1.0 / 3; i < rows; i++) {
    double u = i / rows;
    double columns = floor((1 - u) * convex_distance(a, c) / step) + 2;
    for (double j = 1.0 / 3; j < columns; j++) {
      double v = (1 - u) * j / columns;
      for (size_t k = 0; k < 3; k++) {
        p[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]) - 2 * n[k];
        p[k] = fmin(fmax(p[k], w->line[k][1]), w->line[k][w->size[k] - 1] - 1);
        while (w->line[k][at[k]] > p[k]) at[k]--;
        while (w->line[k][at[k] + 1] <= p[k]) at[k]++;
      }
      unsigned char *cell = &w->cells[convex_cell(w, at[0], at[1], at[2])];
      // itself, and a look to either side
      for (int side = -1; side < 2 && *cell != CONVEX_SURFACE; side++) {
        double far = (side < 0 ? 0 : side ? 4.8 : -4.8) * step;
        convex_add(&w->surface, p[0] + far * n[0], p[1] + far * n[1], p[2] + far * n[2]);
      }
      *cell = CONVEX_SURFACE;
    }
  }
}
// Floods the outside from a corner: what the flood does not reach is inside.
static int convex_flood(convex_work *w) {
  size_t count = w->size[0] * w->size[1] * w->size[2];
  size_t top = 1;
  size_t stride[3] = {w->size[1] * w->size[2], w->size[2], 1};
  size_t *stack = (size_t *)malloc(count * sizeof *stack);
  if (!stack) return 0;
  stack[0] = 0;
  w->cells[0] = CONVEX_OUTSIDE;
  while (top) {
    size_t cell = stack[--top];
    for (size_t axis = 0; axis < 3; axis++) {
      size_t i = cell / stride[axis] % w->size[axis];
      size_t next[2] = {i ? cell - stride[axis] : cell,
                        i + 1 < w->size[axis] ? cell + stride[axis] : cell};
      for (int side = 0; side < 2; side++) {
        if (w->cells[next[side]] != CONVEX_INSIDE) continue;
        w->cells[next[side]] = CONVEX_OUTSIDE;
        stack[top++] = next[side];
      }
    }
  }
  free(stack);
  return 1;
}
static int convex_is_outside(const convex_work *w, const double *p) {
  size_t at[3];
  for (size_t k = 0; k < 3; k++)
    for (at[k] = 0; at[k] + 1 < w->size[k] && w->line[k][at[k] + 1] <= p[k];) at[k]++;
  return w->cells[convex_cell(w, at[0], at[1], at[2])] == CONVEX_OUTSIDE;
}
// Drops surface points with the outside on neither side, a cell away: surfaces within the solid,
// where closed parts of a mesh overlap, say nothing about how deep the solid's own surface lies.
static void convex_keep_outer(convex_work *w) {
  size_t kept = 0;
  for (size_t i = 0; i < w->surface.count; i += 3) {
    if (!convex_is_outside(w, w->surface.at[i + 1]) && !convex_is_outside(w, w->surface.at[i + 2]))
      continue;
    memmove(w->surface.at[kept++], w->surface.at[i], sizeof w->surface.at[0]);
  }
  w->surface.count = kept;
}
static int convex_voxelise(convex_work *w) {
  const nsvcd_mesh *mesh = w->mesh;
  double *values = (double *)malloc((mesh->vertex_count + 1) * sizeof *values);
  double cell = 2 * CONVEX_RANGE / CONVEX_CELLS;
  if (!values) return 0;
  for (size_t axis = 0; axis < 3; axis++) convex_lines(w, axis, cell, values);
  free(values);
  w->cells = (unsigned char *)calloc(w->size[0] * w->size[1] * w->size[2], 1);
  if (!w->cells) return 0;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    const uint32_t *t = mesh->indices + 3 * i;
    const double *a = w->vertices[t[0]];
    const double *b = w->vertices[t[1]];
    const double *c = w->vertices[t[2]];
    double ab = convex_distance(a, b);
    double bc = convex_distance(b, c);
    double ca = convex_distance(c, a);
    if (ab <= bc && ab <= ca)
      convex_mark(w, a, b, c, 0.25 * cell);
    else if (bc <= ca)
      convex_mark(w, b, c, a, 0.25 * cell);
    else
      convex_mark(w, c, a, b, 0.25 * cell);
  }
  if (w->surface.failed || !convex_flood(w)) return 0;
  convex_keep_outer(w);
  return 1;
}

// ------------------------------------------------------------------------------------------- parts

// Cuts a polygon by the plane p[axis] = at; keeps what is on the `side` (1: above, -1: below).
// Returns its corners.
static size_t convex_clip(const double (*in)[3], size_t count, size_t axis, double at, double side,
                          double (*out)[3]) {
  size_t n = 0;
  for (size_t i = 0; i < count; i++) {
    const double *a = in[i];
    const double *b = in[(i + 1) % count];
    double ha = side * (a[axis] - at);
    double hb = side * (b[axis] - at);
    if (ha >= 0) memcpy(out[n++], a, sizeof out[0]);
    if ((ha < 0) == (hb < 0)) continue;
    for (size_t k = 0; k < 3; k++)
      out[n][k] = k == axis ? at : a[k] + ha / (ha - hb) * (b[k] - a[k]);
    n++;
  }
  return n;
}
// Is the triangle part of the surface of what is in the box? One that only touches the box belongs
// to the other side of that plane; one within a side of the box belongs to where the solid is.
static int convex_enters(const double *a, const double *b, const double *c, const double *low,
                         const double *high) {
  double n[3];
  convex_cross(a, b, c, n);
  for (int k = 0; k < 3; k++) {
    double least = fmin(a[k], fmin(b[k], c[k]));
    double most = fmax(a[k], fmax(b[k], c[k]));
    int flat = least >= most;
    if (most < low[k] || least > high[k]) return 0;
    if (most <= low[k] && !(flat && n[k] <= 0)) return 0;
    if (least >= high[k] && !(flat && n[k] > 0)) return 0;
  }
  return 1;
}
static int convex_inside_box(const double *p, const double *low, const double *high) {
  return p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] && p[1] <= high[1] && p[2] >= low[2] &&
         p[2] <= high[2];
}
// The points whose hull is the part's: of the surface cut to its box, and corners of the box deep
// inside the solid.
static void convex_gather(convex_work *w, const convex_box *box, const double *low,
                          const double *high) {
  const nsvcd_mesh *mesh = w->mesh;
  w->points.count = 0;
  w->stamp++;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    const uint32_t *t = mesh->indices + 3 * i;
    double polygon[2][16][3];
    size_t count = 3;
    size_t now = 0;
    size_t inside = 0;
    for (size_t k = 0; k < 3; k++) memcpy(polygon[0][k], w->vertices[t[k]], sizeof polygon[0][k]);
    if (!convex_enters(polygon[0][0], polygon[0][1], polygon[0][2], low, high)) continue;
    for (size_t k = 0; k < 3; k++) inside += (size_t)convex_inside_box(polygon[0][k], low, high);
    for (size_t side = 0; side < 6 && inside < 3; side++, now = !now)
      count =
          convex_clip((const double(*)[3])polygon[now], count, side / 2,
                      side % 2 ? high[side / 2] : low[side / 2], side % 2 ? -1 : 1, polygon[!now]);
    for (size_t k = 0; k < count; k++) {
      const double *p = polygon[now][k];
      if (inside == 3 && w->stamps[t[k]] == w->stamp) continue;  // a vertex, once
      if (inside == 3) w->stamps[t[k]] = w->stamp;
      convex_add(&w->points, floor(p[0] + 0.5), floor(p[1] + 0.5), floor(p[2] + 0.5));
    }
  }
  for (size_t corner = 0; corner < 8; corner++) {
    size_t at[3];
    size_t deep = 1;
    for (size_t k = 0; k < 3; k++) {
      at[k] = corner >> k & 1 ? box->last[k] : box->first[k];
      deep = deep && at[k] > 0 && at[k] < w->size[k];
    }
    for (size_t around = 0; around < 8 && deep; around++)
      deep = w->cells[convex_cell(w, at[0] - (around & 1), at[1] - (around >> 1 & 1),
                                  at[2] - (around >> 2))] == CONVEX_INSIDE;
    if (deep) convex_add(&w->points, w->line[0][at[0]], w->line[1][at[1]], w->line[2][at[2]]);
  }
}
// The hull of the gathered points. Points in one plane, or on a line, are moved off it by a grid
// unit or so.
static int convex_wrap_points(convex_work *w) {
  convex_points *p = &w->points;
  uint32_t noise = 1;
  for (size_t i = 0; p->count && p->count < 4; i++)
    convex_add(p, p->at[i][0], p->at[i][1], p->at[i][2]);
  if (p->failed) return 0;
  if (w->owner_capacity < p->count) {
    free(w->owner);
    w->owner_capacity = p->capacity;
    w->owner = (size_t *)malloc(w->owner_capacity * (2 * sizeof *w->owner + sizeof(double)));
    if (!w->owner) return 0;
  }
  size_t *fan = w->owner + w->owner_capacity;
  double *out = (double *)(void *)(fan + w->owner_capacity);
  for (int attempt = 0; attempt < 8; attempt++) {
    w->hull.points = (const double(*)[3])p->at;
    w->hull.fan = fan;
    if (convex_wrap(&w->hull, p->count, CONVEX_VERTICES, w->owner, out)) return 1;
    for (size_t i = 0; i < 3 * p->count; i++) {
      noise = noise * 1664525u + 1013904223u;
      p->at[i / 3][i % 3] += (double)(noise >> 24 & 3) - 1;
    }
  }
  return 0;
}
// Hull and depth of a part. 1; 0 if no surface is in its box; -1 without memory.
static int convex_measure(convex_work *w, convex_part *part) {
  double low[3], high[3];
  convex_hull *h = &w->hull;
  for (size_t k = 0; k < 3; k++) {
    low[k] = w->line[k][part->box.first[k]];
    high[k] = w->line[k][part->box.last[k]];
  }
  part->count = 0;
  part->depth = 0;
  convex_gather(w, &part->box, low, high);
  if (w->points.count == 0) return 0;
  if (!convex_wrap_points(w)) return -1;
  for (size_t i = 0; i < w->points.count; i++) w->owner[i] = 0;
  for (size_t f = 0; f < h->slots; f++)
    for (size_t k = 0; k < 3 && h->length[f] > 0; k++)
      if (!w->owner[h->corner[f][k]]++)
        memcpy(part->corners[part->count++], h->points[h->corner[f][k]], 3 * sizeof(double));
  for (size_t i = 0; i < w->surface.count; i++) {
    size_t face;
    if (convex_inside_box(w->surface.at[i], low, high))
      part->depth = fmax(part->depth, -convex_highest(h, NULL, h->slots, w->surface.at[i], &face));
  }
  return 1;
}

// The corners of the convex hull of a slab of cells, across `axis`, twice: on the slab's near and
// far plane.
static void convex_outline(convex_work *w, const convex_box *box, size_t axis, size_t slab,
                           double *solid) {
  size_t v = (axis + 1) % 3;
  size_t u = (axis + 2) % 3;
  size_t at[3];
  size_t rows = box->last[v] - box->first[v];
  double rim[2][CONVEX_LINES];
  double width = w->line[axis][slab + 1] - w->line[axis][slab];
  for (size_t r = 0; r <= rows; r++) {
    rim[0][r] = DBL_MAX;
    rim[1][r] = -DBL_MAX;
  }
  at[axis] = slab;
  *solid = 0;
  for (size_t r = 0; r < rows; r++) {
    double filled = 0;
    at[v] = box->first[v] + r;
    for (at[u] = box->first[u]; at[u] < box->last[u]; at[u]++) {
      if (w->cells[convex_cell(w, at[0], at[1], at[2])] == CONVEX_OUTSIDE) continue;
      double a = w->line[u][at[u]];
      double b = w->line[u][at[u] + 1];
      for (size_t k = r; k < r + 2; k++) {
        rim[0][k] = fmin(rim[0][k], a);
        rim[1][k] = fmax(rim[1][k], b);
      }
      filled += b - a;
    }
    *solid += filled * width * (w->line[v][at[v] + 1] - w->line[v][at[v]]);
  }
  for (int side = 0; side < 2; side++) {
    size_t chain[CONVEX_LINES];
    size_t n = 0;
    double sign = side ? -1 : 1;
    double p[3];
    const double *x = w->line[v] + box->first[v];
    const double *y = rim[side];
    for (size_t r = 0; r <= rows; r++) {
      if (fabs(y[r]) > 1e300) continue;
      while (n > 1 && sign * ((x[chain[n - 1]] - x[chain[n - 2]]) * (y[r] - y[chain[n - 2]]) -
                              (y[chain[n - 1]] - y[chain[n - 2]]) * (x[r] - x[chain[n - 2]])) <=
                          0)
        n--;
      chain[n++] = r;
    }
    for (size_t i = 0; i < 2 * n; i++) {
      p[axis] = w->line[axis][slab + i % 2];
      p[v] = x[chain[i / 2]];
      p[u] = y[chain[i / 2]];
      convex_add(&w->points, p[0], p[1], p[2]);
    }
  }
}
// Volumes of the cells' hull before each plane across an axis, or behind it: the hull grows slab by
// slab.
static void convex_grow(convex_work *w, size_t slabs, const size_t *start, int behind,
                        double *volume) {
  size_t begun = 0;
  volume[behind ? slabs : 0] = 0;
  for (size_t i = 0; i < slabs; i++) {
    size_t s = behind ? slabs - 1 - i : i;
    if (!begun && start[s] < start[s + 1])
      begun = (size_t)convex_start(&w->hull, start[s], start[s + 1]);
    for (size_t p = start[s]; p < start[s + 1] && begun; p++) convex_insert(&w->hull, p);
    volume[behind ? s : s + 1] = begun ? w->hull.volume : 0;
  }
}
// The best plane across one axis, if it is better than `best`: the new parts into `halves`.
static double convex_try_axis(convex_work *w, const convex_part *part, size_t axis, double best,
                              convex_part *halves) {
  size_t first = part->box.first[axis];
  size_t slabs = part->box.last[axis] - first;
  size_t start[CONVEX_LINES + 1];
  double before[CONVEX_LINES];
  double behind[CONVEX_LINES];
  double solid[CONVEX_LINES];
  double total = 0;
  double sum = 0;
  w->points.count = 0;
  for (size_t s = 0; s < slabs; s++) {
    start[s] = w->points.count;
    convex_outline(w, &part->box, axis, first + s, &solid[s]);
    total += solid[s];
  }
  start[slabs] = w->points.count;
  size_t *fan = (size_t *)malloc((w->points.count + 1) * sizeof *fan);
  if (!fan || w->points.failed) return free(fan), w->points.failed = 1, best;
  w->hull.points = (const double(*)[3])w->points.at;
  w->hull.fan = fan;
  convex_grow(w, slabs, start, 0, before);
  convex_grow(w, slabs, start, 1, behind);
  free(fan);
  for (size_t s = 1; s < slabs; s++) {
    sum += solid[s - 1];
    if (sum <= 0 || sum >= total) continue;
    // A little for balance: of planes that win nothing, the middle one makes progress.
    double cost = (before[s] + behind[s]) / 6 + CONVEX_BALANCE * fabs(2 * sum - total);
    if (cost >= best) continue;
    best = cost;
    halves[0].box = halves[1].box = part->box;
    halves[0].box.last[axis] = halves[1].box.first[axis] = first + s;
  }
  return best;
}
// Cuts the worst part until all are convex enough or there are enough of them. 0 without memory.
static int convex_decompose(convex_work *w, size_t most, double detail) {
  convex_part *parts = w->parts;
  convex_part *halves = (convex_part *)calloc(2, sizeof *halves);
  if (!halves) return 0;
  for (size_t k = 0; k < 3; k++) {
    parts[0].box.first[k] = 0;
    parts[0].box.last[k] = w->size[k];
  }
  int ok = convex_measure(w, &parts[0]) > 0;
  for (w->part_count = 1; ok && w->part_count < most;) {
    size_t worst = 0;
    double best = DBL_MAX;
    for (size_t i = 1; i < w->part_count; i++)
      if (parts[i].depth > parts[worst].depth) worst = i;
    if (parts[worst].depth <= detail) break;
    for (size_t axis = 0; axis < 3; axis++)
      best = convex_try_axis(w, &parts[worst], axis, best, halves);
    if (!(best < DBL_MAX)) {
      parts[worst].depth = 0;  // one cell: as it is
      continue;
    }
    int left = convex_measure(w, &halves[0]);
    int right = convex_measure(w, &halves[1]);
    ok = left >= 0 && right >= 0 && !w->points.failed;
    parts[worst] = halves[left > 0 ? 0 : 1];
    if (left > 0 && right > 0) parts[w->part_count++] = halves[1];
  }
  free(halves);
  return ok;
}

// -------------------------------------------------------------------------------------------- body

typedef struct convex_body {
  size_t size;                      // bytes
  float center[3], half[3], reach;  // box, and the radius about its centre
  uint32_t count;
  // Of the parts: box centres and half extents, by axis; padded to CONVEX_LANES.
  float middle[3][CONVEX_PARTS], extent[3][CONVEX_PARTS];
  // vertices of a part: x (padded), y (padded), z (padded)
  uint32_t first[CONVEX_PARTS], padded[CONVEX_PARTS];
  float vertices[];
} convex_body;

// Box of vertices (x, y, z each `count`) as middle and half extents. Returns the radius about the
// middle.
static float convex_bound(const float *v, size_t count, float *middle, float *half) {
  float radius = 0;
  for (size_t k = 0; k < 3; k++) {
    float low = v[k * count];
    float high = low;
    for (size_t i = 1; i < count; i++) {
      low = fminf(low, v[k * count + i]);
      high = fmaxf(high, v[k * count + i]);
    }
    middle[k] = (low + high) / 2;
    half[k] = (high - low) / 2 + 1e-7f * (fabsf(low) + fabsf(high));
  }
  for (size_t i = 0; i < count; i++) {
    float x = v[i] - middle[0];
    float y = v[count + i] - middle[1];
    float z = v[2 * count + i] - middle[2];
    radius = fmaxf(radius, sqrtf(x * x + y * y + z * z));
  }
  return radius * (1 + 1e-6f);
}
static convex_body *convex_pack(const convex_work *w) {
  size_t total = 0;
  for (size_t i = 0; i < w->part_count; i++)
    total += (w->parts[i].count + CONVEX_LANES - 1) / CONVEX_LANES * CONVEX_LANES;
  size_t size = sizeof(convex_body) + 3 * total * sizeof(float);
  convex_body *body = (convex_body *)calloc(1, size);
  float low[3], high[3];
  if (!body) return NULL;
  body->size = size;
  body->count = (uint32_t)w->part_count;
  for (size_t i = 0, first = 0; i < w->part_count; i++) {
    const convex_part *part = &w->parts[i];
    size_t padded = (part->count + CONVEX_LANES - 1) / CONVEX_LANES * CONVEX_LANES;
    float *v = body->vertices + first;
    float middle[3];
    float half[3];
    for (size_t k = 0; k < 3; k++)
      for (size_t j = 0; j < padded; j++)
        v[k * padded + j] =
            (float)(w->center[k] + w->unit * part->corners[j < part->count ? j : 0][k]);
    convex_bound(v, padded, middle, half);
    for (size_t k = 0; k < 3; k++) {
      body->middle[k][i] = middle[k];
      body->extent[k][i] = half[k];
      low[k] = i ? fminf(low[k], middle[k] - half[k]) : middle[k] - half[k];
      high[k] = i ? fmaxf(high[k], middle[k] + half[k]) : middle[k] + half[k];
    }
    body->first[i] = (uint32_t)first;
    body->padded[i] = (uint32_t)padded;
    first += 3 * padded;
  }
  for (size_t k = 0; k < 3; k++) {
    body->center[k] = (low[k] + high[k]) / 2;
    body->half[k] = (high[k] - low[k]) / 2;
  }
  for (size_t i = 0; i < w->part_count; i++) {
    const float *v = body->vertices + body->first[i];
    size_t n = body->padded[i];
    for (size_t j = 0; j < n; j++) {
      float x = v[j] - body->center[0];
      float y = v[n + j] - body->center[1];
      float z = v[2 * n + j] - body->center[2];
      body->reach = fmaxf(body->reach, sqrtf(x * x + y * y + z * z) * (1 + 1e-6f));
    }
  }
  return body;
}

// Vertices in grid units, about the centre of those that triangles use. 0 if there is nothing to
// work on.
static int convex_read(convex_work *w) {
  const nsvcd_mesh *mesh = w->mesh;
  double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX};
  double high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    size_t vertex = mesh->indices[i];
    if (vertex >= mesh->vertex_count) return 0;
    w->stamps[vertex] = 1;
    for (size_t k = 0; k < 3; k++) {
      double x = (double)mesh->positions[3 * vertex + k];
      if (!(fabs(x) < 1e30)) return 0;
      low[k] = fmin(low[k], x);
      high[k] = fmax(high[k], x);
    }
  }
  for (size_t k = 0; k < 3 && mesh->triangle_count; k++) {
    w->center[k] = (low[k] + high[k]) / 2;
    w->unit = fmax(w->unit, (high[k] - low[k]) / (2 * CONVEX_RANGE));
  }
  if (!(w->unit > 0)) return 0;
  for (size_t i = 0; i < mesh->vertex_count; i++)
    for (size_t k = 0; k < 3 && w->stamps[i]; k++)
      w->vertices[i][k] =
          floor(((double)mesh->positions[3 * i + k] - w->center[k]) / w->unit + 0.5);
  return 1;
}
static void *convex_prepare(const nsvcd_mesh *mesh, const preparation *how) {
  size_t most = how->points ? how->points : CONVEX_DEFAULT_PARTS;
  double detail =
      (double)(how->detail > 0 ? how->detail : CONVEX_DEFAULT_DETAIL) * 2 * CONVEX_RANGE;
  convex_work *w = (convex_work *)calloc(1, sizeof *w);
  convex_body *body = NULL;
  if (!w) return NULL;
  w->mesh = mesh;
  w->vertices = (double(*)[3])malloc((mesh->vertex_count + 1) * sizeof *w->vertices);
  w->stamps = (uint32_t *)calloc(mesh->vertex_count + 1, sizeof *w->stamps);
  w->stamp = 1;
  if (w->vertices && w->stamps && convex_read(w) && convex_voxelise(w) &&
      convex_decompose(w, most < CONVEX_PARTS ? most : CONVEX_PARTS, detail))
    body = convex_pack(w);
  free(w->vertices);
  free(w->stamps);
  free(w->cells);
  free(w->surface.at);
  free(w->points.at);
  free(w->owner);
  free(w);
  return body;
}
static void *convex_scaled(const void *body, float scale) {
  const convex_body *from = (const convex_body *)body;
  convex_body *to = (convex_body *)malloc(from->size);
  if (!to) return NULL;
  memcpy(to, from, from->size);
  to->reach *= scale;
  for (size_t k = 0; k < 3; k++) {
    to->center[k] *= scale;
    to->half[k] *= scale;
    for (size_t i = 0; i < CONVEX_PARTS; i++) {
      to->middle[k][i] *= scale;
      to->extent[k][i] *= scale;
    }
  }
  for (size_t i = 0; i < (from->size - sizeof *from) / sizeof(float); i++) to->vertices[i] *= scale;
  return to;
}
static void convex_release(void *body) {
  free(body);
}
static size_t convex_bytes(const void *body) {
  return ((const convex_body *)body)->size;
}

// ------------------------------------------------------------------------------------------- query

typedef struct convex_pair {  // what libccd's callbacks need, of one body
  const float *vertices;
  uint32_t padded;
  const transform *at;  // NULL: the fixed body
  float unit;           // 1 / the size of the bodies: libccd's tolerances are absolute
  float grow;           // metres, added all round
  float *axis;          // the last direction asked for, if not NULL
  float center[3];
} convex_pair;

typedef struct convex_query {
  const convex_body *moving, *fixed;
  const transform *at;
  float activation, unit;
  ccd_t ccd;
  size_t nearest[2];  // the pair that came closest last
  int has_nearest;
  unsigned char has_axis[CONVEX_PARTS][CONVEX_PARTS];
  float axis[CONVEX_PARTS][CONVEX_PARTS][3];  // that separated a pair, in the fixed frame
} convex_query;

static void convex_turn(const float *m, const float *v, float *out) {
  for (int i = 0; i < 3; i++) out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}
static void convex_turn_back(const float *m, const float *v, float *out) {
  for (int i = 0; i < 3; i++) out[i] = m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2];
}
// The vertex farthest along d. Lanes by themselves, so that the compiler can keep them in vectors.
static uint32_t convex_farthest(const float *v, uint32_t padded, const float *d, float *height) {
  float best[CONVEX_LANES];
  uint32_t which[CONVEX_LANES];
  uint32_t far = 0;
  const float *x = v;
  const float *y = v + padded;
  const float *z = y + padded;
  for (uint32_t k = 0; k < CONVEX_LANES; k++) {
    best[k] = x[k] * d[0] + y[k] * d[1] + z[k] * d[2];
    which[k] = k;
  }
  for (uint32_t i = CONVEX_LANES; i < padded; i += CONVEX_LANES)
    for (uint32_t k = 0; k < CONVEX_LANES; k++) {
      float h = x[i + k] * d[0] + y[i + k] * d[1] + z[i + k] * d[2];
      which[k] = h > best[k] ? i + k : which[k];
      best[k] = h > best[k] ? h : best[k];
    }
  for (uint32_t k = 1; k < CONVEX_LANES; k++) far = best[k] > best[far] ? k : far;
  *height = best[far];
  return which[far];
}
static void convex_support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out) {
  const convex_pair *s = (const convex_pair *)object;
  double size = fmax(fabs(direction->v[0]), fmax(fabs(direction->v[1]), fabs(direction->v[2])));
  double scale = size > 0 ? 1 / size : 0;  // libccd's directions may be too short for a float
  float d[3], local[3], height, p[3];
  for (int k = 0; k < 3; k++) local[k] = d[k] = (float)(direction->v[k] * scale);
  if (s->axis) memcpy(s->axis, d, sizeof d);
  if (s->at) convex_turn_back(s->at->rotation, d, local);
  uint32_t i = convex_farthest(s->vertices, s->padded, local, &height);
  for (uint32_t k = 0; k < 3; k++) local[k] = p[k] = s->vertices[k * s->padded + i];
  if (s->at) convex_turn(s->at->rotation, local, p);
  float grow = s->grow > 0 ? s->grow / sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + FLT_MIN) : 0;
  for (int k = 0; k < 3; k++)
    out->v[k] = (double)((p[k] + (s->at ? s->at->position[k] : 0) + grow * d[k]) * s->unit);
}
static void convex_center(const void *object, ccd_vec3_t *out) {
  const convex_pair *s = (const convex_pair *)object;
  for (int k = 0; k < 3; k++) out->v[k] = (double)(s->center[k] * s->unit);
}
static void convex_first(const void *a, const void *b, ccd_vec3_t *out) {
  const convex_pair *s = (const convex_pair *)a;
  const convex_pair *t = (const convex_pair *)b;
  for (int k = 0; k < 3; k++)
    out->v[k] = (double)((t->center[k] - s->center[k]) * t->unit) + (k ? 0 : 1e-9);
}
// How far part i of the moving body lies beyond part j of the fixed one along an axis (of the fixed
// frame).
static float convex_gap(const convex_query *q, size_t i, size_t j, const float *axis) {
  const convex_body *a = q->moving;
  const convex_body *b = q->fixed;
  float local[3];
  float back[3] = {-axis[0], -axis[1], -axis[2]};
  float far;
  float near;
  convex_turn_back(q->at->rotation, back, local);
  convex_farthest(b->vertices + b->first[j], b->padded[j], axis, &far);
  convex_farthest(a->vertices + a->first[i], a->padded[i], local, &near);
  float shift =
      axis[0] * q->at->position[0] + axis[1] * q->at->position[1] + axis[2] * q->at->position[2];
  return shift - near - far;
}
static int convex_parts_hit(convex_query *q, size_t i, size_t j) {
  const convex_body *a = q->moving;
  const convex_body *b = q->fixed;
  float *axis = q->axis[i][j];
  float slack = q->activation;
  float length;
  q->nearest[0] = i;
  q->nearest[1] = j;
  q->has_nearest = 1;
  if (q->has_axis[i][j]) {
    length = sqrtf(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    if (convex_gap(q, i, j, axis) > slack * length) return 0;
  }
  convex_pair s = {b->vertices + b->first[j], b->padded[j], NULL,     q->unit,
                   slack > 0 ? slack : 0,     axis,         {0, 0, 0}};
  convex_pair t = {a->vertices + a->first[i], a->padded[i], q->at, q->unit, 0, NULL, {0, 0, 0}};
  float center[3];
  for (int k = 0; k < 3; k++) {
    s.center[k] = b->middle[k][j];
    center[k] = a->middle[k][i];
  }
  convex_turn(q->at->rotation, center, t.center);
  for (int k = 0; k < 3; k++) t.center[k] += q->at->position[k];
  q->has_axis[i][j] = 1;
  if (slack >= 0) return ccdGJKIntersect(&s, &t, &q->ccd);
  ccd_real_t depth = 0;
  ccd_vec3_t direction, point;
  if (ccdMPRPenetration(&s, &t, &q->ccd, &depth, &direction, &point) != 0) return 0;
  for (int k = 0; k < 3; k++) axis[k] = (float)direction.v[k];
  return (float)depth > -slack * q->unit;
}
static int convex_hits_at(convex_query *q) {
  const convex_body *a = q->moving;
  const convex_body *b = q->fixed;
  const float *m = q->at->rotation;
  float slack = q->activation;
  float center[3];
  float magnitude[9];
  float gap[CONVEX_PARTS];
  convex_turn(m, a->center, center);
  float square = 0;
  float reach = a->reach + b->reach + slack;
  for (int k = 0; k < 3; k++) {
    float d = center[k] + q->at->position[k] - b->center[k];
    square += d * d;
  }
  if (reach < 0 || square > reach * reach) return 0;
  if (q->has_nearest && convex_parts_hit(q, q->nearest[0], q->nearest[1])) return 1;
  for (int k = 0; k < 9; k++) magnitude[k] = fabsf(m[k]);
  size_t done_i = q->nearest[0];
  size_t done_j = q->nearest[1];
  size_t done = (size_t)q->has_nearest;
  for (size_t i = 0; i < a->count; i++) {
    float middle[3] = {a->middle[0][i], a->middle[1][i], a->middle[2][i]};
    float half[3];
    float c[3];
    float e[3];
    for (int k = 0; k < 3; k++) half[k] = a->extent[k][i];
    convex_turn(m, middle, c);
    convex_turn(magnitude, half, e);
    int apart = 0;
    for (int k = 0; k < 3; k++) {
      c[k] += q->at->position[k];
      e[k] += slack;
      apart |= fabsf(c[k] - b->center[k]) > b->half[k] + e[k];
    }
    if (apart) continue;
    // in b's frame
    for (size_t j = 0; j < (b->count + CONVEX_LANES - 1) / CONVEX_LANES * CONVEX_LANES; j++) {
      float x = fabsf(c[0] - b->middle[0][j]) - b->extent[0][j] - e[0];
      float y = fabsf(c[1] - b->middle[1][j]) - b->extent[1][j] - e[1];
      float z = fabsf(c[2] - b->middle[2][j]) - b->extent[2][j] - e[2];
      x = x > y ? x : y;
      gap[j] = x > z ? x : z;
    }
    for (size_t j = 0; j < b->count; j++) {
      if (gap[j] > 0 || (done && i == done_i && j == done_j)) continue;
      float d[3] = {c[0] - b->middle[0][j], c[1] - b->middle[1][j], c[2] - b->middle[2][j]};
      float local[3];
      float f[3];
      float other[3] = {b->extent[0][j], b->extent[1][j], b->extent[2][j]};
      convex_turn_back(m, d, local);
      convex_turn_back(magnitude, other, f);  // in a's frame
      for (int k = 0; k < 3; k++) f[k] += half[k] + slack;
      if (fabsf(local[0]) > f[0] || fabsf(local[1]) > f[1] || fabsf(local[2]) > f[2]) continue;
      if (convex_parts_hit(q, i, j)) return 1;
    }
  }
  return 0;
}
static int convex_hits(const void *moving, const void *fixed, const transform *at, size_t count,
                       float activation) {
  convex_query q;
  q.moving = (const convex_body *)moving;
  q.fixed = (const convex_body *)fixed;
  q.activation = activation;
  q.has_nearest = 0;
  q.nearest[0] = q.nearest[1] = 0;
  q.unit = 1 / (q.moving->reach + q.fixed->reach);
  memset(q.has_axis, 0, q.moving->count * sizeof q.has_axis[0]);
  CCD_INIT(&q.ccd);
  q.ccd.support1 = q.ccd.support2 = convex_support;
  q.ccd.center1 = q.ccd.center2 = convex_center;
  q.ccd.first_dir = convex_first;
  q.ccd.max_iterations = 100;
  q.ccd.mpr_tolerance = 1e-4;
  for (size_t i = 0; i < count; i++) {
    q.at = &at[i];
    if (convex_hits_at(&q)) return 1;
  }
  return 0;
}

static const method convex_method = {"convex parts + GJK", convex_prepare, convex_scaled,
                                     convex_release,       convex_bytes,   convex_hits};
#endif  // HAVE_LIBCCD

#endif  // NSVCD_BENCH_CONVEX_H
