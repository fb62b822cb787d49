// In: a mesh of points, segments and triangles, which may all be without area. Out: its pieces, as
// of a region of its own: all triangles whole, in runs of neighbours, each of which is a patch.
#pragma once
#include "pieces.h"

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// triangles of a run, where there are many: no more points than a hull may have
#define NSVCD__RUN_LENGTH 16

// Is some triangle of a mesh a point or a segment?
static int nsvcd__has_points(const nsvcd_mesh *mesh) {
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const uint32_t *v = mesh->indices + 3 * t;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return 1;
  }
  return 0;
}

// How many runs there are to be, where the options do not say.
static size_t nsvcd__runs_for(const nsvcd_mesh *mesh) {
  const size_t triangles = mesh->triangle_count;
  const size_t runs = (triangles + NSVCD__RUN_LENGTH - 1) / NSVCD__RUN_LENGTH;
  if (triangles <= NSVCD_VERY_FEW_TRIANGLES) return triangles;
  return runs < NSVCD_MAX_PATCHES ? runs : NSVCD_MAX_PATCHES;
}

static nsvcd__f3 nsvcd__middle_of(const nsvcd_mesh *mesh, size_t t) {
  const uint32_t *v = mesh->indices + 3 * t;
  nsvcd__f3 sum = nsvcd__f3_row(mesh->positions, v[0]);
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[1]));
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[2]));
  return nsvcd__f3_scale(sum, 1.0f / 3);
}

// The bits of the whole part, up to 10, three places apart.
static uint64_t nsvcd__spread_bits(float from) {
  uint32_t x = (uint32_t)from;
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Sorts numbers by their upper half, 8 bits at a time; equal ones keep their order. spare:
// (count).
static void nsvcd__sort_by_code(uint64_t *keys, uint64_t *spare, size_t count) {
  for (unsigned shift = 32; shift < 64; shift += 8) {
    size_t first[257] = {0};
    for (size_t i = 0; i < count; i++) first[1 + (keys[i] >> shift & 0xff)]++;
    for (size_t n = 0; n < 256; n++) first[n + 1] += first[n];
    for (size_t i = 0; i < count; i++) spare[first[keys[i] >> shift & 0xff]++] = keys[i];
    memcpy(keys, spare, count * sizeof *keys);
  }
}

// The pieces of a mesh, in so many runs, of which each is a patch; region and patches are what they
// are of. The triangles are sorted along a curve that fills space (Morton 1966). Every vertex may
// be a component of its own. 0 without memory.
static int nsvcd__runs_build(const nsvcd_mesh *mesh, size_t runs, nsvcd__arena *arena,
                             nsvcd__region *region, nsvcd__patches *patches,
                             nsvcd__pieces *pieces) {
  const size_t count = mesh->triangle_count;
  nsvcd__f3 low = nsvcd__middle_of(mesh, 0);
  nsvcd__f3 high = low;
  memset(region, 0, sizeof *region);
  memset(patches, 0, sizeof *patches);
  memset(pieces, 0, sizeof *pieces);
  uint64_t *keys = NSVCD__TAKE(arena, uint64_t, 2 * count);
  region->mesh = *mesh;
  region->ids = NSVCD__TAKE(arena, uint32_t, count);
  region->seeds = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  patches->count = runs;
  patches->centres = NSVCD__TAKE(arena, nsvcd__f3, runs);
  pieces->arena = arena;
  pieces->region = region;
  pieces->patches = patches;
  if (!nsvcd__list_reserve(&pieces->list, count, sizeof(nsvcd__piece), arena)) return 0;
  if (arena->failed) return 0;
  memset(region->seeds, 1, mesh->vertex_count);
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    region->greatest = fmax(region->greatest, fabs((double)mesh->positions[i]));
  for (size_t t = 0; t < count; t++) {
    const nsvcd__f3 middle = nsvcd__middle_of(mesh, t);
    region->ids[t] = (uint32_t)t;
    low = nsvcd__f3_min(low, middle);
    high = nsvcd__f3_max(high, middle);
  }

  const nsvcd__f3 size = nsvcd__f3_sub(high, low);
  const float longest = fmaxf(fmaxf(size.x, size.y), size.z);
  const float cells = longest > 0 ? 1023 / longest : 0;
  for (size_t t = 0; t < count; t++) {
    const nsvcd__f3 at = nsvcd__f3_sub(nsvcd__middle_of(mesh, t), low);
    const uint64_t x = nsvcd__spread_bits(cells * at.x);
    const uint64_t y = nsvcd__spread_bits(cells * at.y);
    const uint64_t z = nsvcd__spread_bits(cells * at.z);
    keys[t] = (x | y << 1 | z << 2) << 32 | t;
  }
  nsvcd__sort_by_code(keys, keys + count, count);

  pieces->margin = NSVCD__SURFACE_MARGIN * region->greatest + NSVCD__SURFACE_TINY;
  nsvcd__piece *out = (nsvcd__piece *)pieces->list.items;
  pieces->list.count = count;
  for (size_t k = 0; k < count; k++) {
    const uint32_t triangle = (uint32_t)keys[k];
    const size_t patch = (size_t)((uint64_t)k * runs / count);
    const nsvcd__piece piece = {NSVCD__WHOLE, triangle, (uint16_t)patch, 3, 0};
    patches->centres[patch] = nsvcd__middle_of(mesh, triangle);
    out[k] = piece;
  }
  return 1;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF
