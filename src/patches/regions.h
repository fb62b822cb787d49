// In: a checked mesh. Out: its triangles, welded, in one region; or in as many regions as it takes
// to have at most 512 patches in each, and each is then split into patches by itself. With several
// regions, triangles that are large beside them are halved first. Both halves are kept, and share
// the new corner, so nothing is lost.
#pragma once
#include "../ground/spheres.h"
#include "covering.h"
#include "solids.h"

#ifndef NSVCD_NO_ENCODER
// patches of a region, if there are several
#define NSVCD__REGION_PATCHES 256
// longest edge, in square roots of a region's mean area
#define NSVCD__REGION_EDGE 0.5
// a boundary between regions is located to the width of a bin
#define NSVCD__REGION_BINS 512
// limits the triangles that halving adds
#define NSVCD__HALVES_PER_REGION 256

// Points have numbers: first the vertices of the caller's mesh, then the cuts, which halving adds.
typedef struct nsvcd__regions {
  const nsvcd_mesh *mesh;
  // of all coordinates, absolute
  double greatest;
  size_t component_count;  // C
  nsvcd__solids solids;
  // (vertices) 1: the least vertex of its component, which no patch has yet
  uint8_t *seeds;
  size_t count;  // R
  // T, with halves
  size_t triangle_count;
  // (T, 3) points
  uint32_t *corners;
  // (T) number in the caller's mesh, and kind
  uint32_t *ids;
  size_t cut_count, most_cuts;
  nsvcd__d3 *cuts;  // (most_cuts)
  // metres: a triangle with a longer edge is halved
  double longest_edge;

  // If there are several regions:
  // a triangle's weight: per square metre, and for being one
  double per_area, per_triangle;
  // (T) triangles, region by region
  uint32_t *order;
  // (T) working memory
  uint32_t *spare;
  // (vertices and cuts) numbers of points in the region at hand, from 1; 0: none
  uint32_t *numbers;
  // (R + 1) where regions begin in `order`
  size_t *first;
} nsvcd__regions;

// A part of a mesh. Its last vertices are cuts.
typedef struct nsvcd__region {
  // welded; cuts are rounded
  nsvcd_mesh mesh;
  // coordinate of the whole mesh, absolute
  double greatest;
  uint32_t *ids;  // (triangles)
  // (cut_count) not rounded
  nsvcd__d3 *cuts;
  size_t cut_count;
  uint8_t *seeds;  // (vertices)
  // (vertices) their numbers among the points of all regions; NULL: the same
  uint32_t *vertices;
} nsvcd__region;

static nsvcd__d3 nsvcd__regions_point(const nsvcd__regions *r, uint32_t number) {
  const size_t vertices = r->mesh->vertex_count;
  if (number < vertices) return nsvcd__d3_row(r->mesh->positions, number);
  return r->cuts[number - vertices];
}

static nsvcd__triangle nsvcd__regions_corners(const nsvcd__regions *r,
                                              const uint32_t *corners) {
  const nsvcd__triangle out = {{nsvcd__regions_point(r, corners[0]),
                                nsvcd__regions_point(r, corners[1]),
                                nsvcd__regions_point(r, corners[2])}};
  return out;
}

// Adds a triangle, or its halves if an edge is too long and there is room for them.
static void nsvcd__regions_add(nsvcd__regions *r, const uint32_t *corners, uint32_t id) {
  const nsvcd__triangle triangle = nsvcd__regions_corners(r, corners);
  double e[3];
  const size_t k = nsvcd__edge_squares(&triangle, e);
  if (e[k] <= r->longest_edge * r->longest_edge || r->cut_count == r->most_cuts) {
    memcpy(r->corners + 3 * r->triangle_count, corners, 3 * sizeof *corners);
    r->ids[r->triangle_count++] = id;
    return;
  }
  const uint32_t middle = (uint32_t)(r->mesh->vertex_count + r->cut_count);
  const nsvcd__d3 sum = nsvcd__d3_add(triangle.at[k], triangle.at[(k + 1) % 3]);
  r->cuts[r->cut_count++] = nsvcd__d3_scale(sum, 0.5);
  const uint32_t near_a[3] = {corners[k], middle, corners[(k + 2) % 3]};
  const uint32_t near_b[3] = {middle, corners[(k + 1) % 3], corners[(k + 2) % 3]};
  nsvcd__regions_add(r, near_a, id);
  nsvcd__regions_add(r, near_b, id);
}

static nsvcd__triangle nsvcd__regions_triangle(const nsvcd__regions *r, size_t i) {
  return nsvcd__regions_corners(r, r->corners + 3 * (size_t)r->order[i]);
}
static nsvcd__d3 nsvcd__centroid(const nsvcd__triangle *t) {
  const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(t->at[0], t->at[1]), t->at[2]);
  return nsvcd__d3_scale(sum, 1.0 / 3);
}

// Splits order[first .. end - 1] in two. The first part has about this fraction of the weight. The
// boundary is at the end of a bin across the longest axis of the centroids' box; triangles keep
// their order in each part. Returns where the second one begins.
static size_t nsvcd__regions_split(const nsvcd__regions *r, size_t first, size_t end,
                                   double fraction) {
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = first; i < end; i++) {
    const nsvcd__triangle triangle = nsvcd__regions_triangle(r, i);
    const nsvcd__d3 at = nsvcd__centroid(&triangle);
    low = nsvcd__d3_min(low, at);
    high = nsvcd__d3_max(high, at);
  }
  const nsvcd__d3 size = nsvcd__d3_sub(high, low);
  const size_t axis = nsvcd__d3_longest(size);
  const double longest = nsvcd__d3_axis(size, axis);
  const double per_metre = longest > 1e-30 ? NSVCD__REGION_BINS / longest : 0;

  double weights[NSVCD__REGION_BINS] = {0};
  double all = 0;
  for (size_t i = first; i < end; i++) {
    const nsvcd__triangle triangle = nsvcd__regions_triangle(r, i);
    const double weight = r->per_area * nsvcd__triangle_area(&triangle) + r->per_triangle;
    const nsvcd__d3 from_low = nsvcd__d3_sub(nsvcd__centroid(&triangle), low);
    const double bin =
        fmin(nsvcd__d3_axis(from_low, axis) * per_metre, NSVCD__REGION_BINS - 1);
    r->spare[i - first] = (uint32_t)bin;
    weights[(uint32_t)bin] += weight;
    all += weight;
  }
  uint32_t last_bin = 0;
  for (double sum = weights[0]; last_bin + 2 < NSVCD__REGION_BINS; last_bin++) {
    const double next = weights[last_bin + 1];
    if (!(sum + 0.5 * next < fraction * all)) break;
    sum += next;
  }

  // The second part waits in `spare`, in place of bins that are no longer needed.
  size_t middle = first;
  size_t others = 0;
  for (size_t i = first; i < end; i++) {
    const uint32_t t = r->order[i];
    uint32_t *to = r->spare[i - first] <= last_bin ? &r->order[middle++] : &r->spare[others++];
    *to = t;
  }
  memcpy(r->order + middle, r->spare, others * sizeof *r->spare);
  return middle;
}

// Makes `parts` regions, from number n on, of order[first .. end - 1].
static void nsvcd__regions_part(nsvcd__regions *r, size_t first, size_t end, size_t parts,
                                size_t n) {
  r->first[n] = first;
  if (parts == 1) return;
  const size_t left = parts / 2;
  const double fraction = (double)left / (double)parts;
  const size_t middle = nsvcd__regions_split(r, first, end, fraction);
  nsvcd__regions_part(r, first, middle, left, n);
  nsvcd__regions_part(r, middle, end, parts - left, n + left);
}

// Welds the mesh, and splits it into regions if it is to have more than NSVCD_SMALL_PATCHES
// patches. 0 without memory.
static int nsvcd__regions_build(const nsvcd_mesh *mesh, size_t patches, nsvcd__arena *arena,
                                nsvcd__regions *r) {
  nsvcd__arena scratch = nsvcd__arena_of(arena->allocator);
  nsvcd__topology topology;
  memset(r, 0, sizeof *r);
  r->mesh = mesh;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    r->greatest = fmax(r->greatest, fabs((double)mesh->positions[i]));
  r->count = 1;
  r->longest_edge = HUGE_VAL;
  if (patches > NSVCD_SMALL_PATCHES) {
    r->count = (patches + NSVCD__REGION_PATCHES - 1) / NSVCD__REGION_PATCHES;
    const double area = nsvcd__mesh_area(mesh);
    const double triangles = (double)mesh->triangle_count;
    const double most = triangles + NSVCD__HALVES_PER_REGION * (double)r->count;
    const double edge = NSVCD__REGION_EDGE * sqrt(area / (double)r->count);
    double pieces;
    r->per_area = 0.5 / area;
    r->longest_edge = nsvcd__raise_limit(mesh, edge, most, &pieces);
    // Lengths come from a formula there, but from corners when triangles are halved: the numbers
    // of halves may differ by roundings.
    r->most_cuts = (size_t)(pieces - triangles) + NSVCD__HALVES_PER_REGION;
  }

  const int known = nsvcd__topology_build(mesh, &scratch, &topology) &&
                    nsvcd__solids_build(&topology, arena, &r->solids);
  const size_t most_triangles = mesh->triangle_count + r->most_cuts;
  r->component_count = topology.component_count;
  r->seeds = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  r->corners = NSVCD__TAKE(arena, uint32_t, 3 * most_triangles);
  r->ids = NSVCD__TAKE(arena, uint32_t, most_triangles);
  if (r->count > 1) {
    r->cuts = NSVCD__TAKE(arena, nsvcd__d3, r->most_cuts);
    r->order = NSVCD__TAKE(arena, uint32_t, most_triangles);
    r->spare = NSVCD__TAKE(arena, uint32_t, most_triangles);
    r->numbers = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count + r->most_cuts);
    r->first = NSVCD__TAKE(arena, size_t, r->count + 1);
  }
  const int ok = known && !arena->failed;
  if (ok) memcpy(r->seeds, topology.seen, mesh->vertex_count);
  for (size_t t = 0; ok && t < mesh->triangle_count; t++) {
    uint32_t face[3];
    nsvcd__welded_face(&topology, t, face);
    const uint32_t kind = r->solids.kinds[t];
    nsvcd__regions_add(r, face, (uint32_t)t | kind << NSVCD__KIND_SHIFT);
  }
  nsvcd__arena_free(&scratch);
  if (!ok || r->count == 1) return ok;

  r->per_triangle = 0.5 / (double)r->triangle_count;
  for (uint32_t t = 0; t < r->triangle_count; t++) r->order[t] = t;
  nsvcd__regions_part(r, 0, r->triangle_count, r->count, 0);
  r->first[r->count] = r->triangle_count;
  return 1;
}

// Makes region n. EMPTY if it has no triangle; MEMORY. Call nsvcd__region_end after success.
static nsvcd_result nsvcd__region_begin(nsvcd__regions *r, size_t n, nsvcd__arena *arena,
                                        nsvcd__region *out) {
  memset(out, 0, sizeof *out);
  out->greatest = r->greatest;
  if (r->count == 1) {
    out->mesh = *r->mesh;
    out->mesh.indices = r->corners;
    out->ids = r->ids;
    out->seeds = r->seeds;
    return NSVCD_OK;
  }
  const uint32_t *order = r->order + r->first[n];
  const size_t count = r->first[n + 1] - r->first[n];
  if (count == 0) return NSVCD_ERROR_EMPTY;
  out->mesh.triangle_count = count;
  out->mesh.positions = NSVCD__TAKE(arena, float, 9 * count);
  out->mesh.indices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  out->ids = NSVCD__TAKE(arena, uint32_t, count);
  out->cuts = NSVCD__TAKE(arena, nsvcd__d3, 3 * count);
  out->seeds = NSVCD__TAKE(arena, uint8_t, 3 * count);
  out->vertices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  if (arena->failed) return NSVCD_ERROR_MEMORY;

  // number the points in the region: vertices, then cuts
  size_t points = 0;
  for (int cuts = 0; cuts < 2; cuts++) {
    const size_t before = points;
    for (size_t i = 0; i < 3 * count; i++) {
      const uint32_t v = r->corners[3 * (size_t)order[i / 3] + i % 3];
      const int is_cut = v >= r->mesh->vertex_count;
      if (is_cut != cuts || r->numbers[v]) continue;
      out->vertices[points++] = v;
      r->numbers[v] = (uint32_t)points;
    }
    out->cut_count = points - before;
  }
  out->mesh.vertex_count = points;
  const size_t vertices = points - out->cut_count;
  for (size_t i = 0; i < count; i++) {
    out->ids[i] = r->ids[order[i]];
    for (size_t k = 0; k < 3; k++)
      out->mesh.indices[3 * i + k] = r->numbers[r->corners[3 * (size_t)order[i] + k]] - 1;
  }
  for (size_t v = 0; v < points; v++) {
    const uint32_t from = out->vertices[v];
    const nsvcd__d3 at = nsvcd__regions_point(r, from);
    nsvcd__f3_store(nsvcd__f3_round(at), out->mesh.positions + 3 * v);
    if (v < vertices) out->seeds[v] = r->seeds[from];
    if (v >= vertices) out->cuts[v - vertices] = at;
    r->numbers[from] = 0;
  }
  return NSVCD_OK;
}

// Remembers which seeds patches have been given.
static void nsvcd__region_end(nsvcd__regions *r, const nsvcd__region *region) {
  const size_t vertices = region->mesh.vertex_count - region->cut_count;
  for (size_t v = 0; region->vertices && v < vertices; v++)
    r->seeds[region->vertices[v]] = region->seeds[v];
}
#endif  // NSVCD_NO_ENCODER
