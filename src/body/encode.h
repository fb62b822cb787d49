// In: a mesh. Out: a body. Region by region the surface is split into patches, and these become
// latents and triangles; then all are written into one blob, neighbours side by side.
#pragma once
#include "../surface/surface.h"
#include "../encoder/encoder.h"
#include "trust.h"
#include "write.h"

#ifndef NSVCD_NO_ENCODER
// A body in the making.
typedef struct nsvcd__draft {
  const nsvcd_mesh *mesh;
  // defaults filled in: `patches` is not 0, `latents` tells whether there will be any
  const nsvcd_encode_options *options;
  // of all arrays
  nsvcd__arena arena;
  size_t count;  // N
  // 1: patches are in order
  int in_runs;
  // bytes; 0: without
  size_t latents_size, geometry_size;
  // without latents only centres
  nsvcd__latents latents;
  nsvcd__surface surface;
  nsvcd__writer writer;
} nsvcd__draft;

static int nsvcd__is_cancelled(const nsvcd_encode_options *options, double done) {
  return options->progress && options->progress((float)done, options->user);
}

#ifndef NSVCD_NO_NETWORK
// Adds the latents of a region's patches.
static void nsvcd__add_latents(nsvcd__draft *d, nsvcd__sorted *sorted) {
  const nsvcd__region *region = sorted->pieces->region;
  const nsvcd__patches *patches = sorted->pieces->patches;
  const nsvcd__latents *out = &d->latents;
  for (size_t i = 0; i < patches->count; i++) {
    const size_t to = d->count + i;
    const float radius = patches->radii[i];
    const size_t first = patches->offsets[i];
    nsvcd__encoded patch;
    patch.samples = patches->samples + first;
    patch.normals = patches->normals + first;
    patch.count = patches->offsets[i + 1] - first;
    patch.centre = patches->centres[i];
    patch.inverse_radius = radius > 0 ? 1 / radius : 0;
    float latent[NSVCD__LATENT];
    nsvcd__encode_patch(&patch, latent);
    for (size_t k = 0; k < NSVCD__LATENT; k++)
      out->latents[NSVCD__LATENT * to + k] = (int8_t)lrintf(127 * latent[k]);
    // Cuts are rounded in the region's mesh, each coordinate by at most half a unit in the last
    // place: so far the surface may leave the balls.
    const double margin = 1.1e-7 * region->greatest;
    const double wider = ((double)radius + margin) * (1 + 1e-7);
    out->radii[to] = region->cut_count > 0 ? (float)wider : radius;
    out->areas[to] = patches->area_vectors[i];
    nsvcd__extremes_of(sorted, i, out->radii[to], out->extremes + 3 * NSVCD__EXTREMES * to);
  }
}
#endif

// Adds the patches of region n, at most `most`.
static nsvcd_result nsvcd__add_region(nsvcd__draft *d, nsvcd__regions *regions, size_t n,
                                      size_t most) {
  nsvcd__region region;
  nsvcd__patches patches;
  nsvcd__pieces pieces;
  nsvcd__sorted sorted;
  nsvcd__arena spare = nsvcd__arena_of(d->arena.allocator);
  nsvcd_result result = nsvcd__region_begin(regions, n, &spare, &region);
  if (result == NSVCD_ERROR_EMPTY) return NSVCD_OK;
  if (!result)
    result = nsvcd__patches_build(&region.mesh, most, d->options->latents, &spare, &patches);
  if (!result && (!nsvcd__pieces_build(&region, &patches, &spare, &pieces) ||
                  !nsvcd__sorted_build(&pieces, &spare, &sorted)))
    result = NSVCD_ERROR_MEMORY;
  if (!result) {
    nsvcd__f3 *centres = d->latents.centres + d->count;
    memcpy(centres, patches.centres, patches.count * sizeof *centres);
#ifndef NSVCD_NO_NETWORK
    if (d->options->latents) nsvcd__add_latents(d, &sorted);
#endif
    if (NSVCD__PROOF && !d->options->no_triangles)
      result = nsvcd__surface_add(&sorted, &d->surface);
    d->count += patches.count;
  }
  if (!result) nsvcd__region_end(regions, &region);
  nsvcd__arena_free(&spare);
  return result;
}

// Drafts a mesh that has points or segments, in runs, block by block. There are no latents.
static nsvcd_result nsvcd__draft_runs(nsvcd__draft *d) {
  const nsvcd_mesh *mesh = d->mesh;
  const size_t triangles = mesh->triangle_count;
  const nsvcd_encode_options *o = d->options;
  const size_t runs = o->patches < triangles ? o->patches : triangles;
  nsvcd__arena spare = nsvcd__arena_of(d->arena.allocator);
  nsvcd__surface *s = &d->surface;
  nsvcd__curve curve;
  int ok = nsvcd__surface_begin(runs, mesh->vertex_count, o->coarse, &d->arena, s);
  ok = ok && nsvcd__curve_build(mesh, o->convex_radius, &spare, &curve);
  ok = ok && nsvcd__surface_room(s, mesh->vertex_count, mesh->vertex_count, triangles);
  if (ok) s->solids = curve.solids;
  nsvcd_result result = ok ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  for (size_t first = 0; !result && first < runs; first = s->count) {
    const int is_last = runs - first <= NSVCD__RUNS_AT_ONCE;
    const size_t last = is_last ? runs : first + NSVCD__RUNS_AT_ONCE;
    nsvcd__region block;
    nsvcd__patches patches;
    nsvcd__pieces pieces;
    nsvcd__arena few = nsvcd__arena_of(spare.allocator);
    ok = nsvcd__runs_build(&curve, first, last, runs, &few, &block, &patches, &pieces);
    nsvcd__sorted sorted;
    ok = ok && nsvcd__sorted_build(&pieces, &few, &sorted);
    result = ok ? nsvcd__surface_add(&sorted, s) : NSVCD_ERROR_MEMORY;
    nsvcd__arena_free(&few);
    const double done = (double)last / (double)runs;
    if (!result && nsvcd__is_cancelled(o, 0.9 * done)) result = NSVCD_ERROR_CANCELLED;
  }
  d->count = runs;
  nsvcd__arena_free(&spare);
  return result;
}

// Drafts a mesh region by region.
static nsvcd_result nsvcd__draft_regions(nsvcd__draft *d) {
  const nsvcd_encode_options *o = d->options;
  const size_t patches = o->patches;
  nsvcd__arena *arena = &d->arena;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  nsvcd__regions regions;
  if (!nsvcd__regions_build(d->mesh, patches, &spare, &regions)) {
    nsvcd__arena_free(&spare);
    return NSVCD_ERROR_MEMORY;
  }
  nsvcd__latents *latents = &d->latents;
  latents->centres = NSVCD__TAKE(arena, nsvcd__f3, patches);
#ifndef NSVCD_NO_NETWORK
  const size_t room = o->latents ? patches : 0;
  latents->radii = NSVCD__TAKE(arena, float, room);
  latents->areas = NSVCD__TAKE(arena, nsvcd__f3, room);
  latents->extremes = NSVCD__TAKE(arena, int8_t, 3 * NSVCD__EXTREMES * room);
  latents->latents = NSVCD__TAKE(arena, int8_t, NSVCD__LATENT * room);
#endif
  if (NSVCD__PROOF && !o->no_triangles)
    (void)nsvcd__surface_begin(patches, regions.component_count, o->coarse, arena,
                               &d->surface);
  d->surface.solids = regions.solids;
  const size_t count = regions.count;
  nsvcd_result result = arena->failed ? NSVCD_ERROR_MEMORY : NSVCD_OK;
  for (size_t n = 0; !result && n < count; n++) {
    const size_t most = patches * (n + 1) / count - patches * n / count;
    const double done = (double)(n + 1) / (double)(count + 2);
    const int stop = nsvcd__is_cancelled(o, done);
    result = stop ? NSVCD_ERROR_CANCELLED : nsvcd__add_region(d, &regions, n, most);
  }
  nsvcd__arena_free(&spare);
  return result;
}

// Makes everything but the blob. After success, free the draft's arena. MEMORY, CANCELLED,
// TOO_LARGE.
static nsvcd_result nsvcd__draft_build(const nsvcd_mesh *mesh, const nsvcd_encode_options *o,
                                       const nsvcd_allocator *alloc, nsvcd__draft *d) {
  memset(d, 0, sizeof *d);
  d->mesh = mesh;
  d->options = o;
  d->arena = nsvcd__arena_of(alloc);
  if (nsvcd__is_cancelled(o, 0)) return NSVCD_ERROR_CANCELLED;
  d->in_runs = NSVCD__PROOF && o->convex_radius > 0 && nsvcd__has_points(mesh);
  nsvcd_result result = d->in_runs ? nsvcd__draft_runs(d) : nsvcd__draft_regions(d);
#ifndef NSVCD_NO_NETWORK
  if (!result && o->latents) d->latents_size = nsvcd_body_size(d->count);
#endif
  if (NSVCD__PROOF && !result && !o->no_triangles) {
    nsvcd__writer *w = &d->writer;
    w->surface = &d->surface;
    w->mesh = mesh;
    if (o->balls && mesh->indices && !nsvcd__ball_cover_build(mesh, o, &d->arena, &w->cover))
      result = NSVCD_ERROR_MEMORY;
    if (!result && !nsvcd__geometry_count(w, &d->arena)) result = NSVCD_ERROR_MEMORY;
    w->counts.convex_radius = o->convex_radius;
    d->geometry_size = nsvcd__geometry_layout(NULL, d->count, &w->counts, &w->to);
    if (!result && !d->geometry_size) result = NSVCD_ERROR_TOO_LARGE;
  }
  if (result) nsvcd__arena_free(&d->arena);
  return result;
}

// Orders the patches and writes the blob: the body of latents, then the body of triangles. MEMORY,
// NUMBER, EMPTY.
static nsvcd_result nsvcd__draft_write(nsvcd__draft *d, void *memory) {
  const size_t count = d->count;
  nsvcd__latents *latents = &d->latents;
  latents->count = count;
  latents->open = d->options->open;
  uint16_t *order = NSVCD__TAKE(&d->arena, uint16_t, 2 * count);
  if (!order) return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < count; i++) order[i] = (uint16_t)i;
  if (!d->in_runs) nsvcd__body_order(latents->centres, order, order + count, count);
  latents->order = order;
  nsvcd_result result = NSVCD_OK;
#ifndef NSVCD_NO_NETWORK
  if (d->latents_size) result = nsvcd__body_build(latents, memory);
#endif
  void *to = (char *)memory + d->latents_size;
  if (NSVCD__PROOF && !result && d->geometry_size)
    result = nsvcd__geometry_build(&d->writer, order, latents->open, to, d->geometry_size);
  if (result || !d->latents_size || !d->geometry_size) return result;
  nsvcd_body *b = (nsvcd_body *)memory;
  b->triangles = (uint32_t)d->mesh->triangle_count;
  b->inner = (uint32_t)d->latents_size;
  b->size = (uint32_t)(d->latents_size + d->geometry_size);
  b->checksum = nsvcd__body_checksum(b);
  return NSVCD_OK;
}

// The default number of patches. area: of the mesh, square metres.
static size_t nsvcd__patches_for(const nsvcd_mesh *mesh, float patch_radius, double area,
                                 int triangles) {
  const double most = NSVCD_MAX_PATCHES;
  if (patch_radius > 0) {
    // N balls of radius r cover an area of about N r^2 / 0.45, as measured on real meshes for
    // N = 32 to 512.
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
  if (!NSVCD__PROOF) o->no_triangles = 1;
  if (o->no_triangles) o->latents = 1;
#ifdef NSVCD_NO_NETWORK
  if (o->latents) return NSVCD_ERROR_LATENTS;
#endif
  if (!nsvcd__is_finite(o->patch_radius) || o->patch_radius < 0) return NSVCD_ERROR_PATCHES;
  if (!nsvcd__is_length(o->convex_radius)) return NSVCD_ERROR_RADIUS;
  if (o->convex_radius > 0 && o->latents) return NSVCD_ERROR_LATENTS;
  if (o->patches > NSVCD_MAX_PATCHES) return NSVCD_ERROR_PATCHES;
  if (o->balls > NSVCD_MAX_BALLS) return NSVCD_ERROR_COUNT;
  if (o->balls && o->no_triangles) return NSVCD_ERROR_TRIANGLES;
  const nsvcd_result checked = mesh->indices ? nsvcd__mesh_check(mesh) : NSVCD_OK;
  if (checked) return checked;
  if (o->patches == 0 && o->convex_radius > 0 && nsvcd__has_points(mesh))
    o->patches = nsvcd__runs_for(mesh);
  if (o->patches > 0 && o->convex_radius > 0) return NSVCD_OK;
  const double area = nsvcd__mesh_area(mesh);
  if (!(area > 0) && !(o->convex_radius > 0)) return NSVCD_ERROR_EMPTY;
  if (o->patches == 0)
    o->patches = nsvcd__patches_for(mesh, o->patch_radius, area, !o->no_triangles);
  return NSVCD_OK;
}

// nsvcd_encode of a mesh; or of a checked cloud: a mesh without indices, whose triangle t is point
// t.
static nsvcd_result nsvcd__encode_mesh(const nsvcd_mesh *mesh,
                                       const nsvcd_encode_options *options,
                                       const nsvcd_allocator *alloc, void *memory,
                                       size_t capacity, const nsvcd_body **body) {
  if (!body) return NSVCD_ERROR_ARGUMENT;
  if (memory && !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_encode_options o;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  nsvcd__draft draft;
  nsvcd_result result = nsvcd__encode_resolve(mesh, &o);
  if (!result) result = nsvcd__draft_build(mesh, &o, alloc, &draft);
  if (result) return result;

  const int fits = draft.geometry_size <= 0xffffffffu - draft.latents_size;
  const size_t size = draft.latents_size + draft.geometry_size;
  void *to = memory || !fits ? memory : nsvcd__alloc(alloc, size);
  if (!fits) {
    result = NSVCD_ERROR_TOO_LARGE;
  } else if (!to) {
    result = NSVCD_ERROR_MEMORY;
  } else if ((memory && capacity < size) || !nsvcd__is_aligned(to)) {
    result = NSVCD_ERROR_WORKSPACE;
  } else {
    result = nsvcd__draft_write(&draft, to);
  }
  if (!result) *body = (const nsvcd_body *)to;
  if (result && !memory) nsvcd__free(alloc, to);
  nsvcd__arena_free(&draft.arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *alloc, void *memory, size_t capacity,
                                   const nsvcd_body **body) {
  if (!mesh || !mesh->indices) return nsvcd__mesh_check(mesh);
  return nsvcd__encode_mesh(mesh, options, alloc, memory, capacity, body);
}

NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *alloc) {
  void *memory;
  if (nsvcd__body_check(body, SIZE_MAX)) return;
  // a cast would take away a const
  memcpy(&memory, &body, sizeof memory);
  nsvcd__free(alloc, memory);
}
#endif  // NSVCD_NO_ENCODER
