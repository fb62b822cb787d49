// In: a mesh. Out: a body. Region by region the surface becomes patches, and these become latents
// and triangles; then all of them become one blob, neighbours side by side.
#pragma once
#include "../surface/surface.h"
#include "../encoder/encoder.h"
#include "trust.h"
#include "write.h"

#ifndef NSVCD_NO_ENCODER
// What a body is built of.
typedef struct nsvcd__parts {
  const nsvcd_mesh *mesh;
  // with the defaults filled in: `patches` is not 0, `latents` says whether there are to be any
  const nsvcd_encode_options *options;
  // of all the arrays
  nsvcd__arena arena;
  size_t count;        // N
  nsvcd__f3 *centres;  // (N)
  int in_runs;         // then they are in order
  // bytes; 0: without
  size_t latents_size, facets_size;
#ifndef NSVCD_NO_NETWORK
  // Of a body with latents, else empty:
  float *radii;      // (N)
  nsvcd__f3 *areas;  // (N)
  int8_t *extremes;  // (N, TIPS, 3)
  int8_t *latents;   // (N, LATENT)
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__surface surface;
  nsvcd__geometry_source source;
#endif
} nsvcd__parts;

static int nsvcd__is_cancelled(const nsvcd_encode_options *options, double done) {
  return options->progress && options->progress((float)done, options->user);
}

// Adds the patches of region n, at most so many.
static nsvcd_result nsvcd__parts_add(nsvcd__parts *parts, nsvcd__regions *regions, size_t n,
                                     size_t most) {
  nsvcd__region region;
  nsvcd__patches patches;
  nsvcd__arena spare = nsvcd__arena_of(parts->arena.allocator);
  nsvcd_result result = nsvcd__region_begin(regions, n, &spare, &region);
  if (result == NSVCD_ERROR_EMPTY) return NSVCD_OK;
  if (!result) result = nsvcd__patches_build(&region.mesh, most, &spare, &patches);
  const size_t count = result ? 0 : patches.count;
  for (size_t i = 0; i < count; i++) parts->centres[parts->count + i] = patches.centres[i];
  nsvcd__pieces pieces;
  if (!result && !nsvcd__pieces_build(&region, &patches, &spare, &pieces))
    result = NSVCD_ERROR_MEMORY;
  nsvcd__sorted sorted;
  if (!result && !nsvcd__sorted_build(&pieces, &spare, &sorted)) result = NSVCD_ERROR_MEMORY;
#ifndef NSVCD_NO_NETWORK
  const int latents = parts->options->latents;
  for (size_t i = 0; !result && latents && i < count; i++) {
    const size_t to = parts->count + i;
    const float radius = patches.radii[i];
    const size_t first = patches.offsets[i];
    nsvcd__encoded patch;
    patch.samples = patches.samples + first;
    patch.normals = patches.normals + first;
    patch.count = patches.offsets[i + 1] - first;
    patch.centre = patches.centres[i];
    patch.inverse_radius = radius > 0 ? 1 / radius : 0;
    float latent[NSVCD__LATENT];
    nsvcd__encode_patch(&patch, latent);
    for (size_t k = 0; k < NSVCD__LATENT; k++)
      parts->latents[NSVCD__LATENT * to + k] = (int8_t)lrintf(127 * latent[k]);
    // The mesh has the cuts rounded: each coordinate by half a unit in the last place, at most. By
    // so much the surface may stick out of the balls.
    const double margin = 1.1e-7 * region.greatest;
    const double wider = ((double)radius + margin) * (1 + 1e-7);
    parts->radii[to] = region.cut_count > 0 ? (float)wider : radius;
    parts->areas[to] = patches.area_vectors[i];
    nsvcd__extremes_of(&sorted, i, parts->radii[to],
                       parts->extremes + 3 * NSVCD__EXTREMES * to);
  }
#endif
#ifndef NSVCD_NO_PROOF
  if (!result && !parts->options->no_triangles)
    result = nsvcd__surface_add(&sorted, &parts->surface);
#endif
  parts->count += count;
  if (!result) nsvcd__region_end(regions, &region);
  nsvcd__arena_free(&spare);
  return result;
}

#ifndef NSVCD_NO_PROOF
// All of a mesh that has points or segments, in runs, block by block. Without latents.
static nsvcd_result nsvcd__parts_of_runs(nsvcd__parts *parts) {
  const nsvcd_mesh *mesh = parts->mesh;
  const size_t triangles = mesh->triangle_count;
  const size_t wanted = parts->options->patches;
  const size_t runs = wanted < triangles ? wanted : triangles;
  nsvcd__arena spare = nsvcd__arena_of(parts->arena.allocator);
  nsvcd__surface *surface = &parts->surface;
  nsvcd__curve curve;
  int ok = nsvcd__surface_begin(runs, mesh->vertex_count, parts->options->coarse,
                                &parts->arena, surface);
  ok = ok && nsvcd__curve_build(mesh, parts->options->convex_radius, &spare, &curve);
  ok = ok && nsvcd__surface_room(surface, mesh->vertex_count, mesh->vertex_count, triangles);
  if (ok) surface->solids = curve.solids;
  nsvcd_result result = ok ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  for (size_t first = 0; !result && first < runs; first = surface->done) {
    const size_t left = runs - first;
    const size_t last = first + (left < NSVCD__RUNS_AT_ONCE ? left : NSVCD__RUNS_AT_ONCE);
    nsvcd__region block;
    nsvcd__patches patches;
    nsvcd__pieces pieces;
    nsvcd__arena few = nsvcd__arena_of(spare.allocator);
    ok = nsvcd__runs_build(&curve, first, last, runs, &few, &block, &patches, &pieces);
    nsvcd__sorted sorted;
    ok = ok && nsvcd__sorted_build(&pieces, &few, &sorted);
    result = ok ? nsvcd__surface_add(&sorted, surface) : NSVCD_ERROR_MEMORY;
    nsvcd__arena_free(&few);
    const double done = (double)last / (double)runs;
    if (!result && nsvcd__is_cancelled(parts->options, 0.9 * done))
      result = NSVCD_ERROR_CANCELLED;
  }
  parts->count = runs;
  nsvcd__arena_free(&spare);
  return result;
}
#endif

// All of it, region by region.
static nsvcd_result nsvcd__parts_of_regions(nsvcd__parts *parts) {
  const nsvcd_encode_options *options = parts->options;
  const size_t patches = options->patches;
  nsvcd__arena *arena = &parts->arena;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  nsvcd__regions regions;
  if (!nsvcd__regions_build(parts->mesh, patches, &spare, &regions)) {
    nsvcd__arena_free(&spare);
    return NSVCD_ERROR_MEMORY;
  }
  parts->centres = NSVCD__TAKE(arena, nsvcd__f3, patches);
#ifndef NSVCD_NO_NETWORK
  const size_t latents = options->latents ? patches : 0;
  parts->radii = NSVCD__TAKE(arena, float, latents);
  parts->areas = NSVCD__TAKE(arena, nsvcd__f3, latents);
  parts->extremes = NSVCD__TAKE(arena, int8_t, 3 * NSVCD__EXTREMES * latents);
  parts->latents = NSVCD__TAKE(arena, int8_t, NSVCD__LATENT * latents);
#endif
#ifndef NSVCD_NO_PROOF
  if (!options->no_triangles)
    (void)nsvcd__surface_begin(patches, regions.component_count, options->coarse, arena,
                               &parts->surface);
  parts->surface.solids = regions.solids;
#endif
  const size_t count = regions.count;
  nsvcd_result result = arena->failed ? NSVCD_ERROR_MEMORY : NSVCD_OK;
  for (size_t n = 0; !result && n < count; n++) {
    const size_t most = patches * (n + 1) / count - patches * n / count;
    const double done = (double)(n + 1) / (double)(count + 2);
    const int stop = nsvcd__is_cancelled(options, done);
    result = stop ? NSVCD_ERROR_CANCELLED : nsvcd__parts_add(parts, &regions, n, most);
  }
  nsvcd__arena_free(&spare);
  return result;
}

// Everything but the blob. On success release with nsvcd__arena_free. MEMORY, CANCELLED, TOO_LARGE.
static nsvcd_result nsvcd__parts_build(const nsvcd_mesh *mesh,
                                       const nsvcd_encode_options *options,
                                       const nsvcd_allocator *allocator, nsvcd__parts *parts) {
  memset(parts, 0, sizeof *parts);
  parts->mesh = mesh;
  parts->options = options;
  parts->arena = nsvcd__arena_of(allocator);
  if (nsvcd__is_cancelled(options, 0)) return NSVCD_ERROR_CANCELLED;
  nsvcd_result result = NSVCD_OK;
#ifndef NSVCD_NO_PROOF
  parts->in_runs = options->convex_radius > 0 && nsvcd__has_points(mesh);
  if (parts->in_runs) result = nsvcd__parts_of_runs(parts);
#endif
  if (!parts->in_runs) result = nsvcd__parts_of_regions(parts);
#ifndef NSVCD_NO_NETWORK
  if (!result && options->latents) parts->latents_size = nsvcd_body_size(parts->count);
#endif
#ifndef NSVCD_NO_PROOF
  if (!result && !options->no_triangles) {
    nsvcd__geometry none;
    parts->source.surface = &parts->surface;
    parts->source.mesh = mesh;
    if (!nsvcd__geometry_count(&parts->source, &parts->arena)) result = NSVCD_ERROR_MEMORY;
    parts->source.counts.convex_radius = options->convex_radius;
    parts->facets_size =
        nsvcd__geometry_layout(NULL, parts->count, &parts->source.counts, &none);
    if (!result && !parts->facets_size) result = NSVCD_ERROR_TOO_LARGE;
  }
#endif
  if (result) nsvcd__arena_free(&parts->arena);
  return result;
}

// Puts the patches in order and writes the blob, (latents_size + facets_size) bytes: the body of
// latents, then the body of triangles. MEMORY, NUMBER, EMPTY.
static nsvcd_result nsvcd__parts_write(nsvcd__parts *parts, void *memory) {
  const size_t count = parts->count;
  const size_t triangles = parts->mesh->triangle_count;
  const int open = parts->options->open;
  nsvcd_body *b = (nsvcd_body *)memory;
  uint16_t *order = NSVCD__TAKE(&parts->arena, uint16_t, 2 * count);
  if (!order) return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < count; i++) order[i] = (uint16_t)i;
  const nsvcd__ordering all = {parts->centres, order, order + count, count};
  if (!parts->in_runs) nsvcd__body_order(all);
  nsvcd_result result = NSVCD_OK;
#ifndef NSVCD_NO_NETWORK
  if (parts->latents_size) {
    nsvcd__latents_source source;
    source.count = count;
    source.centres = parts->centres;
    source.radii = parts->radii;
    source.areas = parts->areas;
    source.extremes = parts->extremes;
    source.latents = parts->latents;
    source.order = order;
    source.open = open;
    result = nsvcd__body_build(&source, memory);
  }
#endif
#ifndef NSVCD_NO_PROOF
  if (!result && parts->facets_size) {
    void *to = (char *)memory + parts->latents_size;
    result = nsvcd__geometry_build(&parts->source, order, open, to, parts->facets_size);
  }
#endif
  if (result || !parts->latents_size || !parts->facets_size) return result;
  b->triangles = (uint32_t)triangles;
  b->inner = (uint32_t)parts->latents_size;
  b->size = (uint32_t)(parts->latents_size + parts->facets_size);
  b->checksum = nsvcd__body_checksum(b);
  return NSVCD_OK;
}

// How many patches, where the options do not say. area: of the mesh, square metres.
static size_t nsvcd__patches_for(const nsvcd_mesh *mesh, float patch_radius, double area,
                                 int triangles) {
  const double most = NSVCD_MAX_PATCHES;
  if (patch_radius > 0) {
    // N balls of radius r cover about N r^2 / 0.45 of surface: measured, on the real meshes, for N
    // = 32 to 512.
    const double square = (double)patch_radius * (double)patch_radius;
    const double count = ceil(0.45 * area / square);
    return (size_t)fmin(fmax(count, 1), most);
  }
  if (!triangles) return NSVCD_DEFAULT_NETWORK_PATCHES;
  if (mesh->triangle_count <= NSVCD_LEAST_PATCHES) return NSVCD_LEAST_PATCHES;
  if (mesh->triangle_count <= NSVCD_VERY_FEW_TRIANGLES) return mesh->triangle_count;
  const int is_level = mesh->triangle_count > NSVCD_MANY_TRIANGLES;
  const size_t each = is_level ? NSVCD_LEVEL_TRIANGLES : NSVCD_PATCH_TRIANGLES;
  const size_t limit = is_level ? NSVCD_MAX_PATCHES : NSVCD_SMALL_PATCHES;
  const size_t count = mesh->triangle_count / each;
  if (count < NSVCD_DEFAULT_PATCHES) return NSVCD_DEFAULT_PATCHES;
  return count < limit ? count : limit;
}

// Checks options and mesh, and fills in the defaults.
static nsvcd_result nsvcd__encode_resolve(const nsvcd_mesh *mesh, nsvcd_encode_options *o) {
#ifdef NSVCD_NO_PROOF
  o->no_triangles = 1;
#endif
  if (o->no_triangles) o->latents = 1;
#ifdef NSVCD_NO_NETWORK
  if (o->latents) return NSVCD_ERROR_LATENTS;
#endif
  if (!nsvcd__is_finite(o->patch_radius)) return NSVCD_ERROR_PATCHES;
  if (o->patch_radius < 0) return NSVCD_ERROR_PATCHES;
  if (!nsvcd__in_range(&o->convex_radius, 1, NSVCD_MAX_COORDINATE) || o->convex_radius < 0)
    return NSVCD_ERROR_RADIUS;
  if (o->convex_radius > 0 && o->latents) return NSVCD_ERROR_LATENTS;
  if (o->patches > NSVCD_MAX_PATCHES) return NSVCD_ERROR_PATCHES;
  const nsvcd_result checked = mesh->indices ? nsvcd__mesh_check(mesh) : NSVCD_OK;
  if (checked) return checked;
#ifndef NSVCD_NO_PROOF
  if (o->patches == 0 && o->convex_radius > 0 && nsvcd__has_points(mesh))
    o->patches = nsvcd__runs_for(mesh);
#endif
  if (o->patches > 0 && o->convex_radius > 0) return NSVCD_OK;
  const double area = nsvcd__mesh_area(mesh);
  if (!(area > 0) && !(o->convex_radius > 0)) return NSVCD_ERROR_EMPTY;
  if (o->patches == 0)
    o->patches = nsvcd__patches_for(mesh, o->patch_radius, area, !o->no_triangles);
  return NSVCD_OK;
}

// nsvcd_encode of a mesh, or of a cloud that has been checked: a mesh without indices, of which
// triangle t is point t.
static nsvcd_result nsvcd__encode_mesh(const nsvcd_mesh *mesh,
                                       const nsvcd_encode_options *options,
                                       const nsvcd_allocator *allocator, void *memory,
                                       size_t capacity, const nsvcd_body **body) {
  if (!body) return NSVCD_ERROR_ARGUMENT;
  if (memory && !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_encode_options o;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  nsvcd__parts parts;
  nsvcd_result result = nsvcd__encode_resolve(mesh, &o);
  if (!result) result = nsvcd__parts_build(mesh, &o, allocator, &parts);
  if (result) return result;

  const int fits = parts.facets_size <= 0xffffffffu - parts.latents_size;
  const size_t size = parts.latents_size + parts.facets_size;
  void *to = memory || !fits ? memory : nsvcd__alloc(allocator, size);
  if (!fits) {
    result = NSVCD_ERROR_TOO_LARGE;
  } else if (!to) {
    result = NSVCD_ERROR_MEMORY;
  } else if ((memory && capacity < size) || !nsvcd__is_aligned(to)) {
    result = NSVCD_ERROR_WORKSPACE;
  } else {
    result = nsvcd__parts_write(&parts, to);
  }
  if (!result) *body = (const nsvcd_body *)to;
  if (result && !memory) nsvcd__free(allocator, to);
  nsvcd__arena_free(&parts.arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *allocator, void *memory,
                                   size_t capacity, const nsvcd_body **body) {
  if (!mesh || !mesh->indices) return nsvcd__mesh_check(mesh);
  return nsvcd__encode_mesh(mesh, options, allocator, memory, capacity, body);
}

NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *allocator) {
  void *memory;
  if (nsvcd__body_check(body, SIZE_MAX)) return;
  // a cast would take away a const
  memcpy(&memory, &body, sizeof memory);
  nsvcd__free(allocator, memory);
}
#endif  // NSVCD_NO_ENCODER
