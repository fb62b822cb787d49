// In: pieces, sorted by patch. Out: nsvcd__surface: for each patch an outer description of the
// surface in it (ball, slab, hull), and its triangles. The proof builds on it.
//
// What holds. Every point of the mesh lies in a piece, and every piece belongs to one patch. That
// patch lists the piece's triangle, or the piece itself if the triangle is large beside the
// patches. Its ball, its slab, and its hull inflated by the margin contain the piece. Triangles
// without area are surface like others.
//
// Why it holds. Pieces cover the mesh (surface/pieces). Each number is taken from the corners of
// pieces, about what is stored in float, and then rounded outwards. A piece is the convex hull of
// its corners, and ball, slab and inflated hull are convex: what contains the corners contains the
// piece. The corners are off by roundings of double: all bounds are wider by NSVCD__SURFACE_MARGIN.
#pragma once
#include "../mesh/mesh.h"
#include "runs.h"
#include "slabs.h"
#include "sorted.h"

#ifndef NSVCD_NO_ENCODER
// as many as corners of 16 bits can number
#define NSVCD__PATCH_VERTICES 65536u

// The surface in a patch. c: the ball's centre.
typedef struct nsvcd__patch_bounds {
  // an empty patch has radius NSVCD__NOWHERE
  nsvcd__sphere ball;
  nsvcd__slab slab;  // about c
  // metres per integer: a stored point is c + step (x, y, z)
  float step;
  // metres: pieces are within this of the hull of the first stored points
  float margin;
  // metres: corners that are stored points are within this of the exact ones
  float error;
  // how many of these points: 1..NSVCD__HULL; 0: the patch is empty
  uint8_t hull_count;
  // where its stored points, its names and its triangles begin
  uint32_t first_vertex, first_named, first_triangle;
} nsvcd__patch_bounds;

typedef struct nsvcd__surface {
  nsvcd__arena *arena;
  // N, patches so far
  size_t count;
  // (N + 1) the last one only tells where the others end
  nsvcd__patch_bounds *patches;
  // 1: all corners are stored points, and none is named
  int coarse;
  // V, stored points
  size_t vertex_count;
  size_t named_count;  // M, names
  // L, triangles
  size_t listed;
  // (V, 3) patch by patch x of its stored points, then y, then z: the hull's, then corners that
  // cuts have made
  int16_t *vertices;
  // (M) patch by patch the caller's vertices that are corners
  uint32_t *named;
  // (L, 3) numbers in the patch: of stored points, then of names
  uint16_t *corners;
  // (L) triangle of the mesh, and its kind
  uint32_t *ids;
  // these four arrays
  nsvcd__list lists[4];
  nsvcd__solids solids;
  // C, components that are known so far, of each a vertex, and a patch that has it as a corner
  size_t seed_count;
  nsvcd__f3 *seeds;
  uint32_t *seed_patches;
} nsvcd__surface;

// Twice the area vector of the pieces of patch i.
static nsvcd__d3 nsvcd__patch_normal(const nsvcd__sorted *all, size_t i) {
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
    const nsvcd__piece *piece = nsvcd__sorted_piece(all, k);
    const uint32_t *corners = nsvcd__piece_corners(all->pieces, piece);
    if (corners[0] == corners[2]) continue;
    const nsvcd__d3 from = nsvcd__point_at(all->pieces, corners[0]);
    nsvcd__d3 area = nsvcd__d3_of(0, 0, 0);
    for (size_t j = 2; j < piece->count; j++) {
      const nsvcd__d3 last = nsvcd__point_at(all->pieces, corners[j - 1]);
      const nsvcd__d3 at = nsvcd__point_at(all->pieces, corners[j]);
      const nsvcd__d3 a = nsvcd__d3_sub(last, from);
      area = nsvcd__d3_add(area, nsvcd__d3_cross(a, nsvcd__d3_sub(at, from)));
    }
    normal = nsvcd__d3_add(normal, area);
  }
  return normal;
}

// Finds ball, slab and hull of patch i. Rounding the hull's points to integers is not in the margin
// yet. hull: (NSVCD__HULL) points.
static void nsvcd__describe_patch(nsvcd__sorted *all, size_t i, nsvcd__surface *s,
                                  uint32_t *hull) {
  const nsvcd__pieces *pieces = all->pieces;
  const nsvcd__region *region = pieces->region;
  nsvcd__patch_bounds *out = &s->patches[s->count];
  nsvcd__number_corners(all, i);
  if (all->met_count == 0) {
    out->ball.centre = pieces->patches->centres[i];
    out->ball.radius = NSVCD__NOWHERE;
    return;
  }
  for (size_t j = 0; j < all->met_count; j++) {
    const uint32_t point = all->met[j];
    if (point >= region->mesh.vertex_count || !region->seeds[point]) continue;
    region->seeds[point] = 0;
    s->seeds[s->seed_count] = nsvcd__f3_row(region->mesh.positions, point);
    s->seed_patches[s->seed_count++] = (uint32_t)s->count;
  }

  // The ball's centre is found near the origin, where roundings are small.
  const nsvcd__d3 from = nsvcd__point_at(pieces, all->met[0]);
  const nsvcd__d3 offset = nsvcd__ball_centre(nsvcd__place_points(all, from));
  out->ball.centre = nsvcd__f3_round(nsvcd__d3_add(from, offset));
  const nsvcd__d3 centre = nsvcd__d3_widen(out->ball.centre);
  const nsvcd__points about = nsvcd__place_points(all, centre);
  double radius = 0;
  for (size_t j = 0; j < about.count; j++)
    radius = nsvcd__max(radius, nsvcd__d3_norm(about.at[j]));
  out->ball.radius = nsvcd__float_above(radius + pieces->margin);
  const nsvcd__d3 normal = nsvcd__patch_normal(all, i);
  out->slab = nsvcd__fit_slab(about, normal, pieces->margin, pieces->thin);

  size_t chosen[NSVCD__HULL];
  double farthest;
  const double enough = NSVCD__HULL_FRACTION * (double)out->ball.radius;
  const size_t count = nsvcd__choose_hull(about, NSVCD__HULL, enough, all->bounds,
                                          all->nearest, chosen, &farthest);
  // roundings of the searches for the nearest points, which go on from each other
  const double searches = farthest > 0 ? NSVCD__SURFACE_MARGIN * radius : 0;
  out->margin = nsvcd__float_above(farthest + pieces->margin + searches);
  out->hull_count = (uint8_t)count;
  for (size_t k = 0; k < count; k++) hull[k] = all->met[chosen[k]];
}

// What patch i lists for its k-th piece: the piece if its triangle is divided, else the triangle.
// Returns the number of corners, or 0 for nothing: pieces of a triangle follow each other in a
// patch, and the whole triangle is listed with the first.
static size_t nsvcd__listed_corners(const nsvcd__sorted *all, size_t i, size_t k,
                                    const uint32_t **corners) {
  const nsvcd__piece *piece = nsvcd__sorted_piece(all, k);
  *corners = nsvcd__piece_corners(all->pieces, piece);
  if (piece->divided) return piece->count;
  *corners = nsvcd__triangle_corners(all->pieces, piece->triangle);
  const int is_first = k == all->first[i];
  return is_first || nsvcd__sorted_piece(all, k - 1)->triangle != piece->triangle ? 3 : 0;
}

// Is a point named, as a vertex of the caller's mesh?
static int nsvcd__is_named(const nsvcd__sorted *all, const nsvcd__surface *s, uint32_t point) {
  const nsvcd__region *region = all->pieces->region;
  return !s->coarse && point < region->mesh.vertex_count - region->cut_count;
}

// Numbers the points of patch i: the hull's, then corners that are not named, then, from *stored
// on, those that are. Returns how many triangles the patch lists.
static size_t nsvcd__number_vertices(nsvcd__sorted *all, size_t i, const nsvcd__surface *s,
                                     const uint32_t *hull, size_t *stored) {
  size_t listed = 0;
  nsvcd__begin_pass(all);
  for (size_t k = 0; k < s->patches[s->count].hull_count; k++)
    nsvcd__number_point(all, hull[k]);
  for (int named = 0; named < 2; named++) {
    listed = 0;
    // points of the hull that are named have two numbers
    all->pass += (uint32_t)named;
    if (named) *stored = all->met_count;
    for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
      const uint32_t *corners;
      const size_t count = nsvcd__listed_corners(all, i, k, &corners);
      for (size_t j = 0; j < count; j++) {
        if (nsvcd__is_named(all, s, corners[j]) == named) nsvcd__number_point(all, corners[j]);
      }
      listed += count ? count - 2 : 0;
    }
  }
  return listed;
}

// Writes the points of patch i, the first `stored` as integers and the others as names, and its
// triangles.
static void nsvcd__store_patch(nsvcd__sorted *all, size_t i, nsvcd__surface *s,
                               size_t stored) {
  const nsvcd__region *region = all->pieces->region;
  nsvcd__patch_bounds *out = &s->patches[s->count];
  const nsvcd__d3 centre = nsvcd__d3_widen(out->ball.centre);
  const nsvcd__points points = nsvcd__place_points(all, centre);
  for (size_t j = stored; j < points.count; j++) {
    const uint32_t point = all->met[j];
    s->named[s->named_count++] = region->vertices ? region->vertices[point] : point;
  }
  double greatest = NSVCD__SURFACE_TINY;
  for (size_t j = 0; j < 3 * stored; j++)
    greatest = nsvcd__max(greatest, fabs(nsvcd__d3_axis(points.at[j / 3], j % 3)));
  out->step = nsvcd__float_above(greatest / 32767);
  const double metres = (double)out->step;
  int16_t *vertices = s->vertices + 3 * s->vertex_count;
  double worst = 0;
  double worst_of_hull = 0;
  int has_stored = 0;  // corners
  for (size_t j = 0; j < stored; j++) {
    nsvcd__d3 rounded = {0, 0, 0};
    for (size_t k = 0; k < 3; k++) {
      const double nearest = floor(nsvcd__d3_axis(points.at[j], k) / metres + 0.5);
      const double integer = nsvcd__min(nsvcd__max(nearest, -32767), 32767);
      vertices[k * stored + j] = (int16_t)integer;
      nsvcd__d3_set_axis(&rounded, k, metres * integer);
    }
    all->bounds[j] = nsvcd__d3_norm(nsvcd__d3_sub(points.at[j], rounded));
    if (j < out->hull_count) worst_of_hull = nsvcd__max(worst_of_hull, all->bounds[j]);
  }
  s->vertex_count += stored;
  // no point of the hull is off by more than its vertices
  out->margin = nsvcd__float_above((double)out->margin + worst_of_hull);

  for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
    const uint32_t triangle = nsvcd__sorted_piece(all, k)->triangle;
    const uint32_t *corners;
    const size_t count = nsvcd__listed_corners(all, i, k, &corners);
    for (size_t j = 2; j < count; j++) {
      uint16_t *to = s->corners + 3 * s->listed;
      for (size_t n = 0; n < 3; n++) {
        const uint32_t number = all->numbers[corners[n ? j - 2 + n : 0]];
        to[n] = (uint16_t)number;
        if (number >= stored) continue;
        worst = nsvcd__max(worst, all->bounds[number]);
        has_stored = 1;
      }
      s->ids[s->listed++] = region->ids[triangle];
    }
  }
  worst += all->pieces->margin;
  out->error = has_stored ? nsvcd__float_above(worst) : 0;
}

// ---- all of it

// Begins a surface of up to n patches. components: C, at most. coarse: 1: corners are stored as
// integers. 0 without memory.
static int nsvcd__surface_begin(size_t n, size_t components, int coarse, nsvcd__arena *arena,
                                nsvcd__surface *s) {
  memset(s, 0, sizeof *s);
  s->arena = arena;
  s->coarse = coarse;
  s->patches = NSVCD__TAKE(arena, nsvcd__patch_bounds, n + 1);
  s->seeds = NSVCD__TAKE(arena, nsvcd__f3, components);
  s->seed_patches = NSVCD__TAKE(arena, uint32_t, components);
  return !arena->failed;
}

// Makes room for more stored points, names and triangles. 0 without memory.
static int nsvcd__surface_room(nsvcd__surface *s, size_t stored, size_t named,
                               size_t triangles) {
  const size_t counts[4] = {s->vertex_count, s->named_count, s->listed, s->listed};
  const size_t more[4] = {stored, named, triangles, triangles};
  for (size_t k = 0; k < 4; k++) {
    const size_t size = k % 2 ? sizeof(uint32_t) : 3 * sizeof(int16_t);
    s->lists[k].count = counts[k];
    if (!nsvcd__list_reserve(&s->lists[k], more[k], size, s->arena)) return 0;
  }
  s->vertices = (int16_t *)s->lists[0].items;
  s->named = (uint32_t *)s->lists[1].items;
  s->corners = (uint16_t *)s->lists[2].items;
  s->ids = (uint32_t *)s->lists[3].items;
  return 1;
}

// Adds the patches of a region. MEMORY; TOO_LARGE if a patch has more than NSVCD__PATCH_VERTICES
// points, or there are too many in all. After a failure the surface is of no use.
static nsvcd_result nsvcd__surface_add(nsvcd__sorted *all, nsvcd__surface *s) {
  const nsvcd__pieces *pieces = all->pieces;
  // usually enough, so that lists need not grow
  if (!nsvcd__surface_room(s, 0, pieces->list.count, pieces->list.count))
    return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < pieces->patches->count; i++) {
    uint32_t hull[NSVCD__HULL];
    size_t stored = 0;
    nsvcd__describe_patch(all, i, s, hull);
    const size_t triangles = nsvcd__number_vertices(all, i, s, hull, &stored);
    const size_t named = all->met_count - stored;
    if (all->met_count > NSVCD__PATCH_VERTICES ||
        s->vertex_count + stored > NSVCD__MAX_COUNT ||
        s->listed + triangles > NSVCD__MAX_COUNT || s->named_count + named > NSVCD__MAX_COUNT)
      return NSVCD_ERROR_TOO_LARGE;
    if (!nsvcd__surface_room(s, stored, named, triangles)) return NSVCD_ERROR_MEMORY;
    if (triangles > 0) nsvcd__store_patch(all, i, s, stored);
    nsvcd__patch_bounds *next = &s->patches[++s->count];
    next->first_vertex = (uint32_t)s->vertex_count;
    next->first_named = (uint32_t)s->named_count;
    next->first_triangle = (uint32_t)s->listed;
  }
  return NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER
