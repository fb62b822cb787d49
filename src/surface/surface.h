// In: pieces, sorted by patch. Out: nsvcd__surface: of each patch a ball, a slab, a hull, its
// triangles, all rounded outwards.
#pragma once
#include "../mesh/mesh.h"
#include "runs.h"
#include "slabs.h"
#include "sorted.h"

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// Ball, slab and hull of patch i of the region, which is `to` of all. What the vertices will be off
// by as integers is not in the margin yet.
static void nsvcd__describe_patch(nsvcd__sorted *sorted, size_t i, nsvcd__surface *s) {
  const nsvcd__pieces *pieces = sorted->pieces;
  const nsvcd__region *region = pieces->region;
  const size_t to = s->done + i;
  nsvcd__sphere *ball = &s->balls[to];
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  sorted->pass++;
  sorted->met_count = 0;
  for (size_t k = sorted->first[i]; k < sorted->first[i + 1]; k++) {
    const nsvcd__piece *piece = nsvcd__sorted_piece(sorted, k);
    const uint32_t *corners = nsvcd__piece_corners(pieces, piece);
    const nsvcd__d3 from = nsvcd__point_at(pieces, corners[0]);
    // twice the area times the normal
    nsvcd__d3 area = nsvcd__d3_of(0, 0, 0);
    // a point has no area, and is met once
    const int is_point = corners[0] == corners[1] && corners[1] == corners[2];
    for (size_t j = 0; j < piece->count && (j == 0 || !is_point); j++) {
      const uint32_t point = corners[j];
      nsvcd__number_point(sorted, point);
      // of a component that no patch has been given yet?
      if (point < region->mesh.vertex_count && region->seeds[point]) {
        region->seeds[point] = 0;
        s->seeds[s->seed_count] = nsvcd__f3_row(region->mesh.positions, point);
        s->seed_patches[s->seed_count++] = (uint32_t)to;
      }
      if (j < 2) continue;
      const nsvcd__d3 a = nsvcd__d3_sub(nsvcd__point_at(pieces, corners[j - 1]), from);
      const nsvcd__d3 b = nsvcd__d3_sub(nsvcd__point_at(pieces, point), from);
      area = nsvcd__d3_add(area, nsvcd__d3_cross(a, b));
    }
    normal = nsvcd__d3_add(normal, area);
  }
  if (sorted->met_count == 0) {
    ball->centre = pieces->patches->centres[i];
    ball->radius = NSVCD__NOWHERE;
    return;
  }

  // The least ball. From near by its centre is found without the roundings of what is far away.
  const nsvcd__d3 from = nsvcd__point_at(pieces, sorted->met[0]);
  const nsvcd__d3 offset = nsvcd__ball_centre(nsvcd__place_points(sorted, from));
  ball->centre = nsvcd__f3_round(nsvcd__d3_add(from, offset));
  const nsvcd__points about = nsvcd__place_points(sorted, nsvcd__d3_widen(ball->centre));
  double radius = 0;
  for (size_t j = 0; j < about.count; j++)
    radius = nsvcd__max(radius, nsvcd__d3_length(about.at[j]));
  ball->radius = nsvcd__float_above(radius + pieces->margin);
  s->slabs[to] = nsvcd__fit_slab(about, normal, pieces->margin, pieces->thin);

  size_t chosen[NSVCD__HULL];
  double farthest;
  const double enough = NSVCD__HULL_FRACTION * (double)ball->radius;
  const size_t count =
      nsvcd__choose_hull(about, NSVCD__HULL, enough, sorted->bounds, chosen, &farthest);
  s->margins[to] = nsvcd__float_above(farthest + pieces->margin);
  s->hull_counts[to] = (uint8_t)count;
  for (size_t k = 0; k < count; k++)
    sorted->hulls[NSVCD__HULL * i + k] = sorted->met[chosen[k]];
}

// What patch i lists for its k-th piece: the piece's corners where its triangle is separated, else
// the triangle's. Returns how many corners; 0: nothing more, for pieces of one triangle follow each
// other in a patch, and a whole triangle is listed with the first of them.
static size_t nsvcd__listed_corners(const nsvcd__sorted *sorted, size_t i, size_t k,
                                    const uint32_t **corners) {
  const nsvcd__piece *piece = nsvcd__sorted_piece(sorted, k);
  *corners = nsvcd__piece_corners(sorted->pieces, piece);
  if (piece->divided) return piece->count;
  *corners = nsvcd__triangle_corners(sorted->pieces, piece->triangle);
  const int first = k == sorted->first[i];
  return first || nsvcd__sorted_piece(sorted, k - 1)->triangle != piece->triangle ? 3 : 0;
}

// Is a point a vertex of the caller's mesh, which is named, and not stored as integers?
static int nsvcd__is_named(const nsvcd__sorted *sorted, const nsvcd__surface *s,
                           uint32_t point) {
  const nsvcd__region *region = sorted->pieces->region;
  return !s->coarse && point < region->mesh.vertex_count - region->cut_count;
}

// Numbers the points of patch i: the hull's, then corners that are not named, then, from *stored
// on, those that are. Returns how many triangles it lists.
static size_t nsvcd__number_vertices(nsvcd__sorted *sorted, size_t i, const nsvcd__surface *s,
                                     size_t *stored) {
  const size_t hull_count = s->hull_counts[s->done + i];
  size_t listed = 0;
  sorted->pass++;
  sorted->met_count = 0;
  for (size_t k = 0; k < hull_count; k++)
    nsvcd__number_point(sorted, sorted->hulls[NSVCD__HULL * i + k]);
  for (int named = 0; named < 2; named++) {
    listed = 0;
    // what is in the hull is met again
    sorted->pass += (uint32_t)named;
    if (named) *stored = sorted->met_count;
    for (size_t k = sorted->first[i]; k < sorted->first[i + 1]; k++) {
      const uint32_t *corners;
      const size_t count = nsvcd__listed_corners(sorted, i, k, &corners);
      for (size_t j = 0; j < count; j++) {
        if (nsvcd__is_named(sorted, s, corners[j]) == named)
          nsvcd__number_point(sorted, corners[j]);
      }
      listed += count ? count - 2 : 0;
    }
  }
  return listed;
}

// Writes the points of patch i, of which so many are stored as integers, and its triangles.
static void nsvcd__store_patch(nsvcd__sorted *sorted, size_t i, nsvcd__surface *s) {
  const size_t to = s->done + i;
  const size_t hull_count = s->hull_counts[to];
  const nsvcd__region *region = sorted->pieces->region;
  size_t stored;
  (void)nsvcd__number_vertices(sorted, i, s, &stored);
  const nsvcd__d3 centre = nsvcd__d3_widen(s->balls[to].centre);
  const nsvcd__points points = nsvcd__place_points(sorted, centre);
  uint32_t *named = s->named + s->first_named[to];
  for (size_t j = stored; j < points.count; j++) {
    const uint32_t point = sorted->met[j];
    *named++ = region->vertices ? region->vertices[point] : point;
  }
  double greatest = NSVCD__SURFACE_TINY;
  for (size_t j = 0; j < stored; j++) {
    for (size_t k = 0; k < 3; k++)
      greatest = nsvcd__max(greatest, fabs(nsvcd__d3_axis(points.at[j], k)));
  }
  s->steps[to] = nsvcd__float_above(greatest / 32767);
  const double metres = (double)s->steps[to];
  int16_t *vertices = s->vertices + 3 * (size_t)s->first_vertex[to];
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
    sorted->bounds[j] = nsvcd__d3_length(nsvcd__d3_sub(points.at[j], rounded));
    if (j < hull_count) worst_of_hull = nsvcd__max(worst_of_hull, sorted->bounds[j]);
  }
  // Each point of the hull is off by no more than its vertices are.
  s->margins[to] = nsvcd__float_above((double)s->margins[to] + worst_of_hull);

  for (size_t k = sorted->first[i]; k < sorted->first[i + 1]; k++) {
    const uint32_t triangle = nsvcd__sorted_piece(sorted, k)->triangle;
    const uint32_t *corners;
    const size_t count = nsvcd__listed_corners(sorted, i, k, &corners);
    for (size_t j = 2; j < count; j++) {
      uint16_t *out = s->corners + 3 * s->listed;
      for (size_t n = 0; n < 3; n++) {
        const uint32_t number = sorted->numbers[corners[n ? j - 2 + n : 0]];
        out[n] = (uint16_t)number;
        if (number >= stored) continue;
        worst = nsvcd__max(worst, sorted->bounds[number]);
        has_stored = 1;
      }
      s->ids[s->listed++] = region->ids[triangle];
    }
  }
  worst += sorted->pieces->margin;
  s->errors[to] = has_stored ? nsvcd__float_above(worst) : 0;
}

// ---- all of it

// A surface of up to n patches, none of which is described yet. coarse: 1 if corners are to be
// stored as integers. 0 without memory.
static int nsvcd__surface_begin(size_t n, size_t components, int coarse, nsvcd__arena *arena,
                                nsvcd__surface *s) {
  memset(s, 0, sizeof *s);
  s->arena = arena;
  s->coarse = coarse;
  s->component_count = components;
  s->balls = NSVCD__TAKE(arena, nsvcd__sphere, n);
  s->slabs = NSVCD__TAKE(arena, nsvcd__slab, n);
  s->steps = NSVCD__TAKE(arena, float, n);
  s->margins = NSVCD__TAKE(arena, float, n);
  s->errors = NSVCD__TAKE(arena, float, n);
  s->hull_counts = NSVCD__TAKE(arena, uint8_t, n);
  s->first_vertex = NSVCD__TAKE(arena, uint32_t, n + 1);
  s->first_named = NSVCD__TAKE(arena, uint32_t, n + 1);
  s->first_triangle = NSVCD__TAKE(arena, uint32_t, n + 1);
  s->seeds = NSVCD__TAKE(arena, nsvcd__f3, components);
  s->seed_patches = NSVCD__TAKE(arena, uint32_t, components);
  return !arena->failed;
}

// Makes room for more points, stored and named, and entries. 0 without memory.
static int nsvcd__surface_room(nsvcd__surface *s, size_t vertices, size_t named,
                               size_t triangles) {
  nsvcd__list *lists[] = {&s->vertex_list, &s->named_list, &s->corner_list, &s->id_list};
  const size_t counts[] = {s->vertex_count, s->named_count, s->listed, s->listed};
  const size_t more[] = {vertices, named, triangles, triangles};
  for (size_t k = 0; k < 4; k++) {
    const size_t size = k % 2 ? sizeof(uint32_t) : 3 * sizeof(int16_t);
    lists[k]->count = counts[k];
    if (!nsvcd__list_reserve(lists[k], more[k], size, s->arena)) return 0;
  }
  s->vertices = (int16_t *)s->vertex_list.items;
  s->named = (uint32_t *)s->named_list.items;
  s->corners = (uint16_t *)s->corner_list.items;
  s->ids = (uint32_t *)s->id_list.items;
  return 1;
}

// Adds the patches of a region, in pieces, of which the surface has room for all: describes each,
// counts its vertices and triangles, makes room for these, and writes them. MEMORY; TOO_LARGE if a
// patch has more than NSVCD__PATCH_VERTICES vertices, or all have too many: then the surface is of
// no use any more.
static nsvcd_result nsvcd__surface_add(nsvcd__sorted *sorted, nsvcd__surface *s) {
  const nsvcd__pieces *pieces = sorted->pieces;
  const size_t done = s->done;
  size_t vertices = s->vertex_count;
  size_t named = s->named_count;
  size_t triangles = s->listed;
  s->count = done + pieces->patches->count;
  for (size_t i = done; i < s->count; i++) {
    nsvcd__describe_patch(sorted, i - done, s);
    s->first_vertex[i] = (uint32_t)vertices;
    s->first_named[i] = (uint32_t)named;
    s->first_triangle[i] = (uint32_t)triangles;
    size_t stored = sorted->met_count;
    // Where nothing is cut, and all points are the hull's, they have been counted.
    const int whole = pieces->corners.count + pieces->region->cut_count == 0;
    if (whole && stored == s->hull_counts[i]) {
      triangles += sorted->first[i - done + 1] - sorted->first[i - done];
      if (!s->coarse) named += stored;
    } else {
      triangles += nsvcd__number_vertices(sorted, i - done, s, &stored);
      named += sorted->met_count - stored;
    }
    vertices += stored;
    if (sorted->met_count > NSVCD__PATCH_VERTICES) return NSVCD_ERROR_TOO_LARGE;
    if (vertices > NSVCD__MAX_COUNT || triangles > NSVCD__MAX_COUNT ||
        named > NSVCD__MAX_COUNT)
      return NSVCD_ERROR_TOO_LARGE;
  }
  s->first_vertex[s->count] = (uint32_t)vertices;
  s->first_named[s->count] = (uint32_t)named;
  s->first_triangle[s->count] = (uint32_t)triangles;
  if (!nsvcd__surface_room(s, vertices - s->vertex_count, named - s->named_count,
                           triangles - s->listed))
    return NSVCD_ERROR_MEMORY;
  s->vertex_count = vertices;
  s->named_count = named;
  for (size_t i = done; i < s->count; i++) {
    if (s->hull_counts[i] > 0) nsvcd__store_patch(sorted, i - done, s);
  }
  s->done = s->count;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF
