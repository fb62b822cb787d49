// In: a mesh, region by region, and the centres of each region's patches, N in all. Out: pieces:
// triangles, cut by the cells of the centres. From them nsvcd__surface is made (surface/surface):
// of every patch an outer description of the surface that belongs to it, and the triangles of that
// surface. A proof of freedom of collision is built on it.
//
// What holds. Every point of the mesh lies in a piece. Every piece is a convex part of one
// triangle, and belongs to one patch. That patch lists the piece's triangle, or the piece itself
// where the triangle is large beside the patches. Its ball, its slab and its hull inflated by the
// margin contain the piece. Triangles without area are surface like others.
//
// Why it holds. A piece is only ever divided in two parts that share the corners between them, and
// both parts are kept. So the pieces cover the mesh whatever the cuts are, and poor cuts can make a
// description only larger. Each number is taken from the corners of the pieces, about what is
// stored in float, and then rounded outwards. A piece is the convex hull of its corners, and so are
// ball, slab and inflated hull convex: what contains the corners contains the piece. The corners
// themselves are off by roundings of double: all bounds are wider by NSVCD__SURFACE_MARGIN.
#pragma once
#include "../ground/spheres.h"
#include "../patches/regions.h"

#ifndef NSVCD_NO_ENCODER
// mean sample radii: how far a piece may extend into another cell
#define NSVCD__SURFACE_OVERLAP 0.5
// mean sample radii: with a longer edge a triangle is listed in parts
#define NSVCD__SURFACE_WHOLE 16.0
// of the mesh's greatest coordinate
#define NSVCD__SURFACE_MARGIN 1e-13
// metres, added to that: keeps clear of what float cannot hold
#define NSVCD__SURFACE_TINY 1e-30
// of the radius: a hull as near as this to all corners is good
#define NSVCD__HULL_FRACTION 1e-4
// corners of a piece, at most
#define NSVCD__PIECE_CORNERS 16
// polygons that wait for their turn (12 at most were seen)
#define NSVCD__WAITING 64
// These two bound the cuts. A fine mesh needs less than one for each triangle, a large face some
// three for each of its patches.
#define NSVCD__CUTS_PER_TRIANGLE 8
#define NSVCD__CUTS_PER_PATCH 64
// vertices and new corners together have numbers of 32 bits
#define NSVCD__MAX_CUTS (1u << 29)
// as many as corners of 16 bits can name
#define NSVCD__PATCH_VERTICES 65536u

// ---- lists that grow

// As zeros it is empty.
typedef struct nsvcd__list {
  void *items;
  size_t count, capacity;
} nsvcd__list;

// Room for `more` patch pairs of so many bytes; 0 without memory, and the list is as it was.
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

typedef struct nsvcd__surface {
  // of all its arrays
  nsvcd__arena *arena;
  size_t count;  // N, of which
  size_t done;   // so many are described by now
  // L, triangles listed, over all patches
  size_t listed;
  // V, points stored as integers, over all patches; and vertices of the mesh that are named
  size_t vertex_count;
  size_t named_count;
  // 1: corners are stored as integers too, and none is named
  int coarse;
  // C, connected components (vertices at the same place are one vertex)
  size_t component_count;
  nsvcd__solids solids;
  // (N) about c; an empty patch has radius NSVCD__NOWHERE
  nsvcd__sphere *balls;
  // (N) about c
  nsvcd__slab *slabs;
  // (N) metres per integer: a stored vertex is c + step * (x, y, z)
  float *steps;
  // (N) metres: every point of a piece is within this of the convex hull of the first
  // hull_counts[i] stored vertices
  float *margins;
  // (N) metres: every corner that is stored as integers is within this of them
  float *errors;
  // (N) 1..NSVCD__HULL; 0 where empty
  uint8_t *hull_counts;
  // (N + 1)
  uint32_t *first_vertex;
  uint32_t *first_named;
  uint32_t *first_triangle;  // (N + 1)
  // patch i: x of its points, then y, then z, at 3 * first_vertex[i]: the hull's, then corners that
  // cuts have made
  int16_t *vertices;
  // patch i, from first_named[i] on: the caller's vertices that are corners
  uint32_t *named;
  // (L, 3) within the patch: numbers of points stored as integers, then those of vertices named
  uint16_t *corners;
  // (L) triangle of the mesh, with what it belongs to
  uint32_t *ids;
  // so many of the C components are known by now
  size_t seed_count;
  // (C) a vertex of each component
  nsvcd__f3 *seeds;
  // (C) a patch with a piece that has it for a corner
  uint32_t *seed_patches;
  // where vertices, names, corners and ids are
  nsvcd__list vertex_list, named_list, corner_list, id_list;
} nsvcd__surface;

// ---- pieces: triangles cut by the cells of the centres

// A convex part of one triangle that is being cut. Its corners are points by number: the mesh's
// welded vertices, then those that cuts have made. While it is divided it may have too many.
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
  // 1: its triangle is listed in parts
  uint8_t divided;
} nsvcd__piece;

#define NSVCD__WHOLE 0xffffffffu

typedef struct nsvcd__pieces {
  nsvcd__arena *arena;
  const nsvcd__region *region;
  const nsvcd__patches *patches;
  // of nsvcd__piece, triangle by triangle
  nsvcd__list list;
  nsvcd__list corners;  // of uint32_t, numbers of points
  // of nsvcd__d3: the points that cuts have made
  nsvcd__list points;
  // (NSVCD__WAITING)
  nsvcd__convex *waiting;
  size_t waiting_count;
  size_t cuts_left;
  // metres: how far a piece may extend beyond its cell
  double overlap;
  // metres: a triangle with a longer edge is listed in parts
  double longest_edge;
  // metres, added to all bounds
  double margin;
  // metres: slabs need not be thinner
  double thin;
} nsvcd__pieces;

static const uint32_t *nsvcd__triangle_corners(const nsvcd__pieces *pieces,
                                               uint32_t triangle) {
  return pieces->region->mesh.indices + 3 * (size_t)triangle;
}
static const uint32_t *nsvcd__piece_corners(const nsvcd__pieces *pieces,
                                            const nsvcd__piece *piece) {
  if (piece->first == NSVCD__WHOLE) return nsvcd__triangle_corners(pieces, piece->triangle);
  return (const uint32_t *)pieces->corners.items + piece->first;
}

static nsvcd__d3 nsvcd__point_at(const nsvcd__pieces *pieces, uint32_t number) {
  const nsvcd__region *region = pieces->region;
  const nsvcd__d3 *made = (const nsvcd__d3 *)pieces->points.items;
  const size_t vertices = region->mesh.vertex_count;
  const size_t firm = vertices - region->cut_count;
  if (number < firm) return nsvcd__d3_row(region->mesh.positions, number);
  if (number < vertices) return region->cuts[number - firm];
  return made[number - vertices];
}

// Divides a polygon where `beyond`, a value at each of its corners, changes its sign: near_part is
// where it is negative. There is room for the points that this makes. 0 if one of the parts has
// less than three corners, which roundings can do, or too many.
static int nsvcd__divide(nsvcd__pieces *pieces, const nsvcd__convex *from,
                         const double *beyond, nsvcd__convex *near_part,
                         nsvcd__convex *far_part) {
  const uint32_t vertices = (uint32_t)pieces->region->mesh.vertex_count;
  const size_t made = pieces->points.count;
  nsvcd__d3 *points = (nsvcd__d3 *)pieces->points.items;
  near_part->count = 0;
  far_part->count = 0;
  for (size_t i = 0; i < from->count; i++) {
    const size_t j = (i + 1) % from->count;
    if (beyond[i] <= 0) near_part->points[near_part->count++] = from->points[i];
    if (beyond[i] >= 0) far_part->points[far_part->count++] = from->points[i];
    const int leaves = beyond[i] < 0 && beyond[j] > 0;
    const int enters = beyond[i] > 0 && beyond[j] < 0;
    if (!leaves && !enters) continue;
    const nsvcd__d3 a = nsvcd__point_at(pieces, from->points[i]);
    const nsvcd__d3 b = nsvcd__point_at(pieces, from->points[j]);
    const uint32_t number = vertices + (uint32_t)pieces->points.count;
    const double fraction = beyond[i] / (beyond[i] - beyond[j]);
    points[pieces->points.count++] = nsvcd__d3_mix(a, b, fraction);
    near_part->points[near_part->count++] = number;
    far_part->points[far_part->count++] = number;
  }
  const size_t most = NSVCD__PIECE_CORNERS;
  if (near_part->count >= 3 && near_part->count <= most && far_part->count >= 3 &&
      far_part->count <= most)
    return 1;
  pieces->points.count = made;
  return 0;
}

// Distance of the polygon's farthest corner.
static double nsvcd__convex_reach(const nsvcd__pieces *pieces, const nsvcd__convex *convex,
                                  nsvcd__d3 from) {
  double squared = 0;
  for (size_t i = 0; i < convex->count; i++) {
    const nsvcd__d3 at = nsvcd__point_at(pieces, convex->points[i]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(at, from));
  }
  return sqrt(squared);
}

// Cuts from the polygon what lies too far beyond its patch's cell; that waits for its turn. 0
// without memory.
static int nsvcd__trim(nsvcd__pieces *pieces, uint32_t patch, nsvcd__convex *convex) {
  const nsvcd__patches *patches = pieces->patches;
  const nsvcd__d3 own = nsvcd__d3_widen(patches->centres[patch]);
  const size_t first = (size_t)patch * NSVCD__NEIGHBOURS;
  double reach = nsvcd__convex_reach(pieces, convex, own);
  for (size_t k = first; k < first + NSVCD__NEIGHBOURS; k++) {
    // The plane is half the gap away, and the planes of all that follow are farther.
    const double plane = sqrt((double)patches->quarter_squares[k]);
    if (reach <= plane + pieces->overlap) break;
    if (pieces->cuts_left == 0 || pieces->waiting_count == NSVCD__WAITING) break;
    const nsvcd__d3 other = nsvcd__d3_widen(patches->centres[patches->neighbours[k]]);
    const nsvcd__d3 across = nsvcd__d3_sub(other, own);
    const nsvcd__d3 middle = nsvcd__d3_mix(own, other, 0.5);
    const double length = nsvcd__d3_length(across);
    double beyond[NSVCD__PIECE_CORNERS];
    double most = -HUGE_VAL;
    for (size_t i = 0; i < convex->count; i++) {
      const nsvcd__d3 at = nsvcd__point_at(pieces, convex->points[i]);
      const double height = nsvcd__d3_dot(nsvcd__d3_sub(at, middle), across);
      beyond[i] = length > 0 ? height / length : -1;
      most = nsvcd__max(most, beyond[i]);
    }
    if (most <= pieces->overlap) continue;
    nsvcd__list *points = &pieces->points;
    if (!nsvcd__list_reserve(points, convex->count, sizeof own, pieces->arena)) return 0;
    nsvcd__convex near_part;
    nsvcd__convex *far_part = &pieces->waiting[pieces->waiting_count];
    if (!nsvcd__divide(pieces, convex, beyond, &near_part, far_part)) continue;
    *convex = near_part;
    pieces->waiting_count++;
    pieces->cuts_left--;
    reach = nsvcd__convex_reach(pieces, convex, own);
  }
  return 1;
}

// Cuts one triangle into pieces. guess: the patch of the piece before. 0 without memory.
static int nsvcd__cut_up(nsvcd__pieces *pieces, uint32_t triangle, uint32_t *guess) {
  const uint32_t *corners = nsvcd__triangle_corners(pieces, triangle);
  nsvcd__piece piece = {NSVCD__WHOLE, triangle, 0, 0, 0};
  double squared = 0;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 a = nsvcd__point_at(pieces, corners[k]);
    const nsvcd__d3 b = nsvcd__point_at(pieces, corners[(k + 1) % 3]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(a, b));
    pieces->waiting[0].points[k] = corners[k];
  }
  piece.divided = sqrt(squared) > pieces->longest_edge;
  pieces->waiting[0].count = 3;
  pieces->waiting_count = 1;
  while (pieces->waiting_count > 0) {
    nsvcd__convex convex = pieces->waiting[--pieces->waiting_count];
    nsvcd__d3 sum = nsvcd__d3_of(0, 0, 0);
    for (size_t i = 0; i < convex.count; i++)
      sum = nsvcd__d3_add(sum, nsvcd__point_at(pieces, convex.points[i]));
    const nsvcd__d3 mean = nsvcd__d3_scale(sum, 1 / (double)convex.count);
    *guess = nsvcd__nearest_centre(pieces->patches, *guess, nsvcd__d3_narrow(mean));
    piece.patch = (uint16_t)*guess;
    if (!nsvcd__trim(pieces, piece.patch, &convex)) return 0;

    nsvcd__list *list = &pieces->corners;
    const size_t bytes = convex.count * sizeof *corners;
    piece.count = (uint8_t)convex.count;
    piece.first = NSVCD__WHOLE;
    if (convex.count != 3 || memcmp(convex.points, corners, bytes) != 0) {
      if (list->count >= NSVCD__WHOLE - NSVCD__PIECE_CORNERS) return 0;
      if (!nsvcd__list_reserve(list, convex.count, sizeof *corners, pieces->arena)) return 0;
      memcpy((uint32_t *)list->items + list->count, convex.points, bytes);
      piece.first = (uint32_t)list->count;
      list->count += convex.count;
    }
    list = &pieces->list;
    if (!nsvcd__list_reserve(list, 1, sizeof piece, pieces->arena)) return 0;
    ((nsvcd__piece *)list->items)[list->count++] = piece;
  }
  return 1;
}

// Cuts the whole region. 0 without memory.
static int nsvcd__pieces_build(const nsvcd__region *region, const nsvcd__patches *patches,
                               nsvcd__arena *arena, nsvcd__pieces *pieces) {
  const size_t triangles = region->mesh.triangle_count;
  double size = 0;
  for (size_t i = 0; i < patches->count; i++) size += (double)patches->sample_radii[i];
  size /= (double)patches->count;
  memset(pieces, 0, sizeof *pieces);
  pieces->arena = arena;
  pieces->region = region;
  pieces->patches = patches;
  pieces->margin = NSVCD__SURFACE_MARGIN * region->greatest + NSVCD__SURFACE_TINY;
  pieces->overlap = NSVCD__SURFACE_OVERLAP * size + pieces->margin;
  pieces->longest_edge = NSVCD__SURFACE_WHOLE * size;
  pieces->cuts_left = NSVCD__CUTS_PER_PATCH * patches->count;
  const size_t room = NSVCD__MAX_CUTS - pieces->cuts_left;
  const int many = triangles > room / NSVCD__CUTS_PER_TRIANGLE;
  pieces->cuts_left += many ? room : NSVCD__CUTS_PER_TRIANGLE * triangles;

  pieces->waiting = NSVCD__TAKE(arena, nsvcd__convex, NSVCD__WAITING);
  // Most triangles are one piece: with room for an eighth more the list seldom needs to grow, which
  // takes it twice.
  const size_t most = triangles + triangles / 8;
  int ok =
      pieces->waiting && nsvcd__list_reserve(&pieces->list, most, sizeof(nsvcd__piece), arena);
  uint32_t guess = 0;
  for (uint32_t t = 0; ok && t < triangles; t++) ok = nsvcd__cut_up(pieces, t, &guess);
  return ok;
}
#endif  // NSVCD_NO_ENCODER
