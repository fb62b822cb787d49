// In: a mesh of points, segments and triangles, which need no area. Out: its pieces, those of a
// region: whole triangles in runs of neighbours, each of which is a patch.
#pragma once
#include "pieces.h"

#ifndef NSVCD_NO_ENCODER
// triangles of a run, if there are many: no more points than a hull can have
#define NSVCD__RUN_LENGTH 16
// runs of a block, so that its memory fits in caches
#define NSVCD__RUNS_AT_ONCE 256
// slabs this thin, as a fraction of the convex radius, are not made thinner
#define NSVCD__RUN_THIN 0.5

// Does a mesh have points or segments for triangles? One without indices is a cloud of points.
static int nsvcd__has_points(const nsvcd_mesh *mesh) {
  if (!mesh->indices) return 1;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    if (!nsvcd__are_distinct(mesh->indices + 3 * t)) return 1;
  }
  return 0;
}

// The default number of runs.
static size_t nsvcd__runs_for(const nsvcd_mesh *mesh) {
  const size_t triangles = mesh->triangle_count;
  const size_t runs = (triangles + NSVCD__RUN_LENGTH - 1) / NSVCD__RUN_LENGTH;
  if (triangles <= NSVCD_VERY_FEW_TRIANGLES) return triangles;
  return runs < NSVCD_MAX_PATCHES ? runs : NSVCD_MAX_PATCHES;
}

// The centroid of triangle t.
static nsvcd__f3 nsvcd__middle_of(const nsvcd_mesh *mesh, size_t t) {
  const uint32_t point[3] = {(uint32_t)t, (uint32_t)t, (uint32_t)t};
  const uint32_t *v = mesh->indices ? mesh->indices + 3 * t : point;
  nsvcd__f3 sum = nsvcd__f3_row(mesh->positions, v[0]);
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[1]));
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[2]));
  return nsvcd__f3_scale(sum, 1.0f / 3);
}

// The bits of a number below 1024, three positions apart.
static uint64_t nsvcd__morton_bits(float from) {
  uint32_t x = (uint32_t)from;
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Radix sort of keys by their upper halves; equal ones keep their order. spare: (count).
static void nsvcd__sort_keys(uint64_t *keys, uint64_t *spare, size_t count) {
  for (unsigned shift = 32; shift < 64; shift += 8) {
    size_t first[257] = {0};
    uint64_t *from = shift & 8 ? spare : keys;
    uint64_t *to = shift & 8 ? keys : spare;
    for (size_t i = 0; i < count; i++) first[1 + (from[i] >> shift & 0xff)]++;
    for (size_t n = 0; n < 256; n++) first[n + 1] += first[n];
    for (size_t i = 0; i < count; i++) to[first[from[i] >> shift & 0xff]++] = from[i];
  }
}

// A mesh along a Z curve (Morton 1966).
typedef struct nsvcd__curve {
  const nsvcd_mesh *mesh;
  // (triangles) the upper half is the position on the curve, the lower one number and kind
  uint64_t *keys;
  // (vertices) when a vertex was last met, counted from 1 over all blocks; 0: never. NULL for a
  // cloud, which has each vertex once
  uint32_t *met;
  uint32_t met_count;
  nsvcd__solids solids;
  // coordinate, absolute
  double greatest;
  double convex_radius;  // metres
} nsvcd__curve;

// Adds the kinds of triangles to the keys. 0 without memory.
static int nsvcd__curve_mark(nsvcd__curve *c, nsvcd__arena *kept) {
  const nsvcd_mesh *mesh = c->mesh;
  // points and segments alone enclose nothing
  if (!mesh->indices || !(nsvcd__mesh_area(mesh) > 0)) return 1;
  nsvcd__topology topology;
  nsvcd__arena arena = nsvcd__arena_of(kept->allocator);
  const int known = nsvcd__topology_build(mesh, &arena, &topology) &&
                    nsvcd__solids_build(&topology, kept, &c->solids);
  for (size_t t = 0; known && t < mesh->triangle_count; t++)
    c->keys[t] |= (uint64_t)c->solids.kinds[t] << NSVCD__KIND_SHIFT;
  nsvcd__arena_free(&arena);
  return known;
}

// Sorts a mesh along the curve. 0 without memory.
static int nsvcd__curve_build(const nsvcd_mesh *mesh, float convex_radius, nsvcd__arena *arena,
                              nsvcd__curve *c) {
  const size_t count = mesh->triangle_count;
  memset(c, 0, sizeof *c);
  c->mesh = mesh;
  c->convex_radius = (double)convex_radius;
  c->keys = NSVCD__TAKE(arena, uint64_t, 2 * count);
  c->met = NSVCD__TAKE(arena, uint32_t, mesh->indices ? mesh->vertex_count : 0);
  if (arena->failed) return 0;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    c->greatest = nsvcd__max(c->greatest, fabs((double)mesh->positions[i]));
  nsvcd__f3 low = nsvcd__middle_of(mesh, 0);
  nsvcd__f3 high = low;
  for (size_t t = 0; t < count; t++) {
    const nsvcd__f3 middle = nsvcd__middle_of(mesh, t);
    low = nsvcd__f3_min(low, middle);
    high = nsvcd__f3_max(high, middle);
  }
  const nsvcd__f3 size = nsvcd__f3_sub(high, low);
  const float longest = fmaxf(fmaxf(size.x, size.y), size.z);
  const float cells = longest > 0 ? 1023 / longest : 0;
  for (size_t t = 0; t < count; t++) {
    const nsvcd__f3 at = nsvcd__f3_sub(nsvcd__middle_of(mesh, t), low);
    const uint64_t x = nsvcd__morton_bits(cells * at.x);
    const uint64_t y = nsvcd__morton_bits(cells * at.y);
    const uint64_t z = nsvcd__morton_bits(cells * at.z);
    c->keys[t] = (x | y << 1 | z << 2) << 32 | t;
  }
  if (!nsvcd__curve_mark(c, arena)) return 0;
  nsvcd__sort_keys(c->keys, c->keys + count, count);
  return 1;
}

// Where a run begins on the curve. None is empty.
static size_t nsvcd__run_begin(size_t triangles, size_t run, size_t runs) {
  return (size_t)(((uint64_t)triangles * run + runs - 1) / runs);
}

// Numbers the vertices of a block in the order in which its triangles have them, and copies them. A
// triangle may be a component of its own if none of its vertices was met before.
static void nsvcd__block_vertices(nsvcd__curve *c, nsvcd__region *b) {
  const nsvcd_mesh *mesh = c->mesh;
  const size_t count = b->mesh.triangle_count;
  const uint32_t before = c->met_count;
  if (!mesh->indices) {
    memcpy(b->vertices, b->ids, count * sizeof *b->vertices);
    memset(b->seeds, 1, count);
    b->mesh.vertex_count = count;
  }
  for (size_t n = 0; mesh->indices && n < 3 * count; n++) {
    const uint32_t *face = &b->mesh.indices[n / 3 * 3];
    uint32_t *met = &c->met[b->mesh.indices[n]];
    if (*met <= before) {
      b->seeds[b->mesh.vertex_count] =
          n % 3 == 0 && !c->met[face[0]] && !c->met[face[1]] && !c->met[face[2]];
      b->vertices[b->mesh.vertex_count++] = b->mesh.indices[n];
      *met = ++c->met_count;
    }
    b->mesh.indices[n] = *met - 1 - before;
  }
  for (size_t i = 0; i < b->mesh.vertex_count; i++) {
    const nsvcd__f3 at = nsvcd__f3_row(mesh->positions, b->vertices[i]);
    nsvcd__f3_store(at, b->mesh.positions + 3 * i);
  }
}

// Makes runs first .. last - 1, each a patch; b and patches are what their pieces refer to. The
// triangles and vertices of a block are copied in the order of the curve, so that the rest reads
// memory from front to back; in short loops, each of which can have many loads from far away in
// flight. 0 without memory.
static int nsvcd__runs_build(nsvcd__curve *c, size_t first, size_t last, size_t runs,
                             nsvcd__arena *arena, nsvcd__region *b, nsvcd__patches *patches,
                             nsvcd__pieces *pieces) {
  const nsvcd_mesh *mesh = c->mesh;
  const size_t all = mesh->triangle_count;
  const size_t begin = nsvcd__run_begin(all, first, runs);
  const size_t count = nsvcd__run_begin(all, last, runs) - begin;
  memset(b, 0, sizeof *b);
  memset(patches, 0, sizeof *patches);
  memset(pieces, 0, sizeof *pieces);
  b->mesh.triangle_count = count;
  const size_t most = 3 * count < mesh->vertex_count ? 3 * count : mesh->vertex_count;
  b->mesh.positions = NSVCD__TAKE(arena, float, 3 * most);
  b->mesh.indices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  b->ids = NSVCD__TAKE(arena, uint32_t, count);
  b->vertices = NSVCD__TAKE(arena, uint32_t, most);
  b->seeds = NSVCD__TAKE(arena, uint8_t, most);
  b->greatest = c->greatest;
  patches->count = last - first;
  pieces->arena = arena;
  pieces->region = b;
  pieces->patches = patches;
  pieces->margin = NSVCD__SURFACE_MARGIN * b->greatest + NSVCD__SURFACE_TINY;
  pieces->thin = NSVCD__RUN_THIN * c->convex_radius;
  if (!nsvcd__list_reserve(&pieces->list, count, sizeof(nsvcd__piece), arena) || arena->failed)
    return 0;
  nsvcd__piece *out = (nsvcd__piece *)pieces->list.items;
  pieces->list.count = count;
  size_t run = first;
  size_t end = 0;
  for (size_t k = 0; k < count; k++) {
    if (k == end) end = nsvcd__run_begin(all, ++run, runs) - begin;
    const nsvcd__piece piece = {NSVCD__WHOLE, (uint32_t)k, (uint16_t)(run - 1 - first), 3, 0};
    out[k] = piece;
    b->ids[k] = (uint32_t)c->keys[begin + k];
    const size_t id = b->ids[k] & NSVCD__NUMBER;
    for (size_t n = 3 * k; n < 3 * k + 3; n++) {
      const size_t corner = 3 * id + n - 3 * k;
      b->mesh.indices[n] = mesh->indices ? mesh->indices[corner] : (uint32_t)k;
    }
  }
  nsvcd__block_vertices(c, b);
  return 1;
}
#endif  // NSVCD_NO_ENCODER
