// In: a region, and the centres of its patches. Out: pieces: triangles, cut by the cells of the
// centres.
//
// A piece is a convex part of one triangle, and belongs to one patch. It is only ever divided into
// two parts that share the new corners, and both are kept. So the pieces cover the mesh wherever
// the cuts are, and poor cuts only make the description of a patch larger (surface/surface).
#pragma once
#include "../ground/spheres.h"
#include "../patches/regions.h"

#ifndef NSVCD_NO_ENCODER
// how far a piece may extend into another cell, in mean sample radii
#define NSVCD__SURFACE_OVERLAP 0.5
// a triangle with a longer edge is listed in pieces, in mean sample radii
#define NSVCD__SURFACE_WHOLE 16.0
// of the mesh's greatest coordinate
#define NSVCD__SURFACE_MARGIN 1e-13
// metres, added to that: keeps clear of what float cannot represent
#define NSVCD__SURFACE_TINY 1e-30
// a hull within this fraction of the radius of all corners is good enough
#define NSVCD__HULL_FRACTION 1e-4
// corners of a piece, at most
#define NSVCD__PIECE_CORNERS 16
// polygons that wait to be cut (at most 12 were seen)
#define NSVCD__WAITING 64
// These limit the cuts. A fine mesh takes less than one for each triangle, a large face about three
// for each of its patches.
#define NSVCD__CUTS_PER_TRIANGLE 8
#define NSVCD__CUTS_PER_PATCH 64
// vertices and cuts share numbers of 32 bits
#define NSVCD__MAX_CUTS (1u << 29)

// An array that grows; empty if it is zeros.
typedef struct nsvcd__list {
  void *items;
  size_t count, capacity;
} nsvcd__list;

// Makes room for `more` items of `size` bytes. 0 without memory: the list is unchanged.
static int nsvcd__list_reserve(nsvcd__list *list, size_t more, size_t size,
                               nsvcd__arena *arena) {
  if (list->capacity - list->count >= more) return 1;
  if (list->count > SIZE_MAX / 2 - more) return 0;
  const size_t capacity = list->count + more + list->count / 2;
  void *items = nsvcd__arena_grow(arena, list->items, list->count * size, capacity, size);
  if (!items) return 0;
  list->items = items;
  list->capacity = capacity;
  return 1;
}

// A polygon that is being cut. Its corners are numbers of points: first the mesh's welded vertices,
// then the points that cuts have made. While it is divided it may have more than
// NSVCD__PIECE_CORNERS.
typedef struct nsvcd__convex {
  uint32_t points[2 * NSVCD__PIECE_CORNERS];
  size_t count;
} nsvcd__convex;

typedef struct nsvcd__piece {
  // of its corners; NSVCD__WHOLE: they are the triangle's
  uint32_t first;
  uint32_t triangle;
  uint16_t patch;
  uint8_t count;  // of its corners
  // 1: its triangle is listed in pieces
  uint8_t divided;
} nsvcd__piece;

#define NSVCD__WHOLE 0xffffffffu

typedef struct nsvcd__pieces {
  nsvcd__arena *arena;
  const nsvcd__region *region;
  const nsvcd__patches *patches;
  // of nsvcd__piece, triangle by triangle
  nsvcd__list list;
  // of uint32_t, numbers of points
  nsvcd__list corners;
  // of nsvcd__d3, points that cuts have made
  nsvcd__list points;
  // (NSVCD__WAITING)
  nsvcd__convex *waiting;
  size_t waiting_count;
  size_t cuts_left;
  // metres that a piece may extend beyond its cell
  double overlap;
  // metres: a triangle with a longer edge is listed in pieces
  double longest_edge;
  // metres, added to all bounds
  double margin;
  // metres: slabs need not be thinner
  double thin;
} nsvcd__pieces;

static const uint32_t *nsvcd__triangle_corners(const nsvcd__pieces *p, uint32_t triangle) {
  return p->region->mesh.indices + 3 * (size_t)triangle;
}
static const uint32_t *nsvcd__piece_corners(const nsvcd__pieces *p,
                                            const nsvcd__piece *piece) {
  if (piece->first == NSVCD__WHOLE) return nsvcd__triangle_corners(p, piece->triangle);
  return (const uint32_t *)p->corners.items + piece->first;
}

static nsvcd__d3 nsvcd__point_at(const nsvcd__pieces *p, uint32_t number) {
  const nsvcd__region *region = p->region;
  const nsvcd__d3 *made = (const nsvcd__d3 *)p->points.items;
  const size_t vertices = region->mesh.vertex_count;
  const size_t first_cut = vertices - region->cut_count;
  if (number < first_cut) return nsvcd__d3_row(region->mesh.positions, number);
  if (number < vertices) return region->cuts[number - first_cut];
  return made[number - vertices];
}

// Divides a polygon where `beyond`, a value at each corner, changes its sign: near_part is where it
// is negative. There must be room for the new points. 0 if a part has less than three corners,
// which roundings can cause, or too many.
static int nsvcd__divide(nsvcd__pieces *p, const nsvcd__convex *from, const double *beyond,
                         nsvcd__convex *near_part, nsvcd__convex *far_part) {
  const uint32_t vertices = (uint32_t)p->region->mesh.vertex_count;
  const size_t made = p->points.count;
  nsvcd__d3 *points = (nsvcd__d3 *)p->points.items;
  near_part->count = 0;
  far_part->count = 0;
  for (size_t i = 0; i < from->count; i++) {
    const size_t j = (i + 1) % from->count;
    if (beyond[i] <= 0) near_part->points[near_part->count++] = from->points[i];
    if (beyond[i] >= 0) far_part->points[far_part->count++] = from->points[i];
    const int leaves = beyond[i] < 0 && beyond[j] > 0;
    const int enters = beyond[i] > 0 && beyond[j] < 0;
    if (!leaves && !enters) continue;
    const nsvcd__d3 a = nsvcd__point_at(p, from->points[i]);
    const nsvcd__d3 b = nsvcd__point_at(p, from->points[j]);
    const uint32_t number = vertices + (uint32_t)p->points.count;
    const double fraction = beyond[i] / (beyond[i] - beyond[j]);
    points[p->points.count++] = nsvcd__d3_mix(a, b, fraction);
    near_part->points[near_part->count++] = number;
    far_part->points[far_part->count++] = number;
  }
  const size_t most = NSVCD__PIECE_CORNERS;
  if (near_part->count >= 3 && near_part->count <= most && far_part->count >= 3 &&
      far_part->count <= most)
    return 1;
  p->points.count = made;
  return 0;
}

// The distance from a point to a polygon's farthest corner.
static double nsvcd__farthest_corner(const nsvcd__pieces *p, const nsvcd__convex *convex,
                                     nsvcd__d3 from) {
  double squared = 0;
  for (size_t i = 0; i < convex->count; i++) {
    const nsvcd__d3 at = nsvcd__point_at(p, convex->points[i]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(at, from));
  }
  return sqrt(squared);
}

// Cuts off the parts of a polygon that extend too far beyond its patch's cell, and puts them aside
// to be cut later. 0 without memory.
static int nsvcd__trim(nsvcd__pieces *p, uint32_t patch, nsvcd__convex *convex) {
  const nsvcd__patches *patches = p->patches;
  const nsvcd__d3 own = nsvcd__d3_widen(patches->centres[patch]);
  const size_t first = (size_t)patch * NSVCD__NEIGHBOURS;
  double farthest = nsvcd__farthest_corner(p, convex, own);
  for (size_t k = first; k < first + NSVCD__NEIGHBOURS; k++) {
    // the cell's side is half the distance away; those of the next neighbours are farther
    const double plane = sqrt((double)patches->quarter_squares[k]);
    if (farthest <= plane + p->overlap) break;
    if (p->cuts_left == 0 || p->waiting_count == NSVCD__WAITING) break;
    const nsvcd__d3 other = nsvcd__d3_widen(patches->centres[patches->neighbours[k]]);
    const nsvcd__d3 across = nsvcd__d3_sub(other, own);
    const nsvcd__d3 middle = nsvcd__d3_mix(own, other, 0.5);
    const double length = nsvcd__d3_norm(across);
    double beyond[NSVCD__PIECE_CORNERS];
    double most = -HUGE_VAL;
    for (size_t i = 0; i < convex->count; i++) {
      const nsvcd__d3 at = nsvcd__point_at(p, convex->points[i]);
      const double height = nsvcd__d3_dot(nsvcd__d3_sub(at, middle), across);
      beyond[i] = length > 0 ? height / length : -1;
      most = nsvcd__max(most, beyond[i]);
    }
    if (most <= p->overlap) continue;
    nsvcd__list *points = &p->points;
    if (!nsvcd__list_reserve(points, convex->count, sizeof own, p->arena)) return 0;
    nsvcd__convex near_part;
    nsvcd__convex *far_part = &p->waiting[p->waiting_count];
    if (!nsvcd__divide(p, convex, beyond, &near_part, far_part)) continue;
    *convex = near_part;
    p->waiting_count++;
    p->cuts_left--;
    farthest = nsvcd__farthest_corner(p, convex, own);
  }
  return 1;
}

// Cuts a triangle into pieces. guess: the last piece's patch. 0 without memory.
static int nsvcd__cut_up(nsvcd__pieces *p, uint32_t triangle, uint32_t *guess) {
  const uint32_t *corners = nsvcd__triangle_corners(p, triangle);
  nsvcd__piece piece = {NSVCD__WHOLE, triangle, 0, 0, 0};
  double squared = 0;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 a = nsvcd__point_at(p, corners[k]);
    const nsvcd__d3 b = nsvcd__point_at(p, corners[(k + 1) % 3]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(a, b));
    p->waiting[0].points[k] = corners[k];
  }
  piece.divided = sqrt(squared) > p->longest_edge;
  p->waiting[0].count = 3;
  p->waiting_count = 1;
  while (p->waiting_count > 0) {
    nsvcd__convex convex = p->waiting[--p->waiting_count];
    nsvcd__d3 sum = nsvcd__d3_of(0, 0, 0);
    for (size_t i = 0; i < convex.count; i++)
      sum = nsvcd__d3_add(sum, nsvcd__point_at(p, convex.points[i]));
    const nsvcd__d3 mean = nsvcd__d3_scale(sum, 1 / (double)convex.count);
    *guess = nsvcd__nearest_centre(p->patches, *guess, nsvcd__d3_narrow(mean));
    piece.patch = (uint16_t)*guess;
    if (!nsvcd__trim(p, piece.patch, &convex)) return 0;

    nsvcd__list *list = &p->corners;
    const size_t bytes = convex.count * sizeof *corners;
    piece.count = (uint8_t)convex.count;
    piece.first = NSVCD__WHOLE;
    if (convex.count != 3 || memcmp(convex.points, corners, bytes) != 0) {
      if (list->count >= NSVCD__WHOLE - NSVCD__PIECE_CORNERS) return 0;
      if (!nsvcd__list_reserve(list, convex.count, sizeof *corners, p->arena)) return 0;
      memcpy((uint32_t *)list->items + list->count, convex.points, bytes);
      piece.first = (uint32_t)list->count;
      list->count += convex.count;
    }
    list = &p->list;
    if (!nsvcd__list_reserve(list, 1, sizeof piece, p->arena)) return 0;
    ((nsvcd__piece *)list->items)[list->count++] = piece;
  }
  return 1;
}

// Cuts a region into pieces. 0 without memory.
static int nsvcd__pieces_build(const nsvcd__region *region, const nsvcd__patches *patches,
                               nsvcd__arena *arena, nsvcd__pieces *p) {
  const size_t triangles = region->mesh.triangle_count;
  double size = 0;
  for (size_t i = 0; i < patches->count; i++) size += (double)patches->sample_radii[i];
  size /= (double)patches->count;
  memset(p, 0, sizeof *p);
  p->arena = arena;
  p->region = region;
  p->patches = patches;
  p->margin = NSVCD__SURFACE_MARGIN * region->greatest + NSVCD__SURFACE_TINY;
  p->overlap = NSVCD__SURFACE_OVERLAP * size + p->margin;
  p->longest_edge = NSVCD__SURFACE_WHOLE * size;
  p->cuts_left = NSVCD__CUTS_PER_PATCH * patches->count;
  const size_t room = NSVCD__MAX_CUTS - p->cuts_left;
  const int many = triangles > room / NSVCD__CUTS_PER_TRIANGLE;
  p->cuts_left += many ? room : NSVCD__CUTS_PER_TRIANGLE * triangles;

  p->waiting = NSVCD__TAKE(arena, nsvcd__convex, NSVCD__WAITING);
  // Most triangles are one piece: with room for an eighth more the list rarely has to grow.
  const size_t most = triangles + triangles / 8;
  int ok = p->waiting && nsvcd__list_reserve(&p->list, most, sizeof(nsvcd__piece), arena);
  uint32_t guess = 0;
  for (uint32_t t = 0; ok && t < triangles; t++) ok = nsvcd__cut_up(p, t, &guess);
  return ok;
}
#endif  // NSVCD_NO_ENCODER
