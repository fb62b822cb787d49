// In: a surface, and its mesh. Out: the body of triangles that body/geometry reads.
#pragma once
#include "../surface/surface.h"
#include "ball_cover.h"
#include "geometry.h"

#ifndef NSVCD_NO_ENCODER
// Writes the codes of patch i; NULL: only counts their bytes. Returns how many.
static size_t nsvcd__numbers_write(const nsvcd__surface *s, size_t i, unsigned char *to) {
  size_t size = 0;
  uint32_t last = 0;
  for (size_t n = s->patches[i].first_triangle; n < s->patches[i + 1].first_triangle; n++) {
    const uint32_t id = s->ids[n];
    const uint32_t kind = id >> NSVCD__KIND_SHIFT;
    uint32_t code = (id - last) & NSVCD__NUMBER;
    code = s->solids.is_mixed ? code << 2 | kind : code << 1 | (kind == NSVCD__CLOSED);
    for (int more = 1; more; code >>= 7) {
      more = code > 0x7f;
      if (to) to[size] = (unsigned char)(more ? code | 0x80 : code);
      size++;
    }
    last = id;
  }
  return size;
}

// What a body of triangles is written from.
typedef struct nsvcd__writer {
  nsvcd__surface *surface;
  const nsvcd_mesh *mesh;
  nsvcd__ball_cover cover;
  // (vertices of the mesh) their numbers in the body, from 1; 0: none yet
  uint32_t *numbers;
  // (triangles) 1: stored in pieces
  uint8_t *cut;
  nsvcd__counts counts;
  nsvcd__geometry to;
} nsvcd__writer;

static size_t nsvcd__mesh_corner(const nsvcd_mesh *mesh, size_t t, size_t k) {
  return mesh->indices ? mesh->indices[3 * t + k] : t;
}

// Is a closed mesh a box along the axes: twelve triangles, each of three corners of the box, two to
// a face?
static uint32_t nsvcd__is_box(const nsvcd_mesh *mesh) {
  nsvcd__d3 low, high;
  int faces[6] = {0};
  if (!mesh->indices || mesh->triangle_count != 12) return 0;
  nsvcd__mesh_box(mesh, &low, &high);
  for (size_t t = 0; t < 12; t++) {
    size_t sides[3] = {0, 0, 0};
    for (size_t n = 0; n < 9; n++) {
      const size_t v = mesh->indices[3 * t + n / 3];
      const double x = (double)mesh->positions[3 * v + n % 3];
      const int is_high = x >= nsvcd__d3_axis(high, n % 3);
      if (!is_high && x > nsvcd__d3_axis(low, n % 3)) return 0;
      sides[n % 3] += (size_t)is_high;
    }
    for (size_t k = 0; k < 3; k++) faces[2 * k + (sides[k] == 3)] += sides[k] % 3 == 0;
  }
  int is_box = 1;
  for (size_t k = 0; k < 6; k++) is_box &= faces[k] == 2;
  return (uint32_t)is_box;
}

// Fills in the writer: counts what the body of a complete surface will have. 0 without memory.
static int nsvcd__geometry_count(nsvcd__writer *w, nsvcd__arena *arena) {
  const nsvcd__surface *s = w->surface;
  const nsvcd_mesh *mesh = w->mesh;
  nsvcd__counts *counts = &w->counts;
  w->numbers = NSVCD__TAKE(arena, uint32_t, s->coarse ? 0 : mesh->vertex_count);
  w->cut = NSVCD__TAKE(arena, uint8_t, s->coarse ? 0 : mesh->triangle_count);
  if (arena->failed) return 0;
  memset(counts, 0, sizeof *counts);
  counts->listed = (uint32_t)s->listed;
  counts->vertices = (uint32_t)s->vertex_count;
  counts->components = (uint32_t)s->seed_count;
  const nsvcd__solids *solids = &s->solids;
  // points alone have no topology
  counts->solids = counts->components;
  if (solids->components > 0) counts->solids = (uint32_t)solids->components;
  counts->open_solids = (uint32_t)solids->open_components;
  counts->open_edges = (uint32_t)solids->open_edges;
  counts->is_mixed = (uint32_t)solids->is_mixed;
  counts->balls = (uint32_t)w->cover.count;
  counts->is_box = solids->components == 1 && !solids->open_components && nsvcd__is_box(mesh);
  if (solids->gap > 0) counts->gap = nsvcd__above(solids->gap);
  uint64_t bytes = 0;
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__patch_bounds *patch = &s->patches[i];
    const size_t stored = patch[1].first_vertex - patch->first_vertex;
    const size_t points = stored + patch[1].first_named - patch->first_named;
    const size_t triangles = patch[1].first_triangle - patch->first_triangle;
    const size_t first = 3 * (size_t)patch->first_triangle;
    bytes += (uint64_t)3 * triangles * nsvcd__corner_bytes(points);
    bytes += nsvcd__numbers_write(s, i, NULL);
    for (size_t n = first; n < first + 3 * triangles && !s->coarse; n++)
      if (s->corners[n] < stored) w->cut[s->ids[n / 3] & NSVCD__NUMBER] = 1;
  }
  for (size_t n = 0; n < s->named_count; n++) {
    counts->positions += !w->numbers[s->named[n]];
    w->numbers[s->named[n]] = 1;
  }
  counts->references = (uint32_t)s->named_count - counts->positions;
  for (size_t n = 0; n < 3 * mesh->triangle_count && !s->coarse; n++) {
    if (!w->cut[n / 3]) continue;
    const size_t v = nsvcd__mesh_corner(mesh, n / 3, n % 3);
    counts->positions += !w->numbers[v];
    w->numbers[v] = 1;
    counts->cut += n % 3 == 0;
  }
  if (!s->coarse) memset(w->numbers, 0, mesh->vertex_count * sizeof *w->numbers);
  // with more the body is refused as too large
  counts->entry_bytes = bytes < 0xffffffffu ? (uint32_t)bytes : 0xffffffffu;
  return 1;
}

// Gives a vertex the next number, and writes its position. Returns the number, from 0.
static uint32_t nsvcd__position_write(nsvcd__writer *w, size_t vertex, uint32_t *count) {
  const float *from = w->mesh->positions + 3 * vertex;
  memcpy(w->to.positions + 3 * (size_t)*count, from, 3 * sizeof *from);
  w->numbers[vertex] = ++*count;
  return *count - 1;
}

// Writes the own vertices and references of patch `to`. Turns the names of the surface's patch
// `from` into numbers of the body's patch.
static void nsvcd__named_write(nsvcd__writer *w, size_t from, size_t to) {
  nsvcd__surface *s = w->surface;
  const nsvcd__geometry *f = &w->to;
  uint32_t *first_own = f->first_own + to;
  uint32_t *first_reference = f->first_reference + to;
  const size_t wide = f->reference_bytes;
  const nsvcd__patch_bounds *patch = &s->patches[from];
  uint32_t *named = s->named + patch->first_named;
  const size_t count = patch[1].first_named - patch->first_named;
  uint32_t own = patch[1].first_vertex - patch->first_vertex;
  uint32_t other = own;
  first_own[1] = first_own[0];
  first_reference[1] = first_reference[0];
  for (size_t n = 0; n < count; n++) other += !w->numbers[named[n]];
  for (size_t n = 0; n < count; n++) {
    const uint32_t number = w->numbers[named[n]];
    if (!number) {
      (void)nsvcd__position_write(w, named[n], &first_own[1]);
      named[n] = own++;
      continue;
    }
    const uint32_t wanted = number - 1;
    const uint16_t narrow = (uint16_t)wanted;
    unsigned char *at = f->references + wide * first_reference[1]++;
    if (wide == 2) memcpy(at, &narrow, 2);
    if (wide == 4) memcpy(at, &wanted, 4);
    named[n] = other++;
  }
}

// Writes the triangles that are stored in pieces, after all patches.
static void nsvcd__cut_write(nsvcd__writer *w) {
  const nsvcd_mesh *mesh = w->mesh;
  uint32_t *cut = w->to.cut;
  uint32_t *corners = w->to.cut_corners;
  uint32_t count = w->to.first_own[w->to.body->patches];
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    if (!w->cut[t]) continue;
    *cut++ = (uint32_t)t;
    for (size_t k = 0; k < 3; k++) {
      const size_t v = nsvcd__mesh_corner(mesh, t, k);
      const uint32_t known = w->numbers[v];
      *corners++ = known ? known - 1 : nsvcd__position_write(w, v, &count);
    }
  }
}

// Writes patch `to` of a body, from patch `from` of its surface. One without surface is a point.
static void nsvcd__patch_write(nsvcd__writer *w, size_t from, size_t to) {
  const nsvcd__surface *s = w->surface;
  const nsvcd__geometry *f = &w->to;
  const size_t padded = f->body->padded;
  const nsvcd__patch_bounds *patch = &s->patches[from];
  nsvcd__sphere ball = patch->ball;
  if (patch->hull_count == 0) ball.radius = 0;
  nsvcd__sphere_store(ball, (float *)(f->body + 1), padded, to);
  nsvcd__slab_store(patch->slab, f->slabs, padded, to);
  f->steps[to] = patch->step;
  f->margins[to] = patch->margin;
  f->errors[to] = patch->error;
  f->hull_counts[to] = patch->hull_count;

  const uint32_t vertex = patch->first_vertex;
  const uint32_t vertices = patch[1].first_vertex - vertex;
  const size_t first = patch->first_triangle;
  const size_t end = patch[1].first_triangle;
  int16_t *integers = f->vertices + 3 * (size_t)f->first_vertex[to];
  memcpy(integers, s->vertices + 3 * (size_t)vertex, 6 * (size_t)vertices);
  nsvcd__named_write(w, from, to);
  const uint32_t *named = s->named + patch->first_named;
  const size_t points = vertices + patch[1].first_named - patch->first_named;
  const size_t bytes = nsvcd__corner_bytes(points);
  unsigned char *begin = f->entries + f->first_byte[to];
  unsigned char *at = begin;
  for (size_t n = 3 * first; n < 3 * end; n++) {
    const size_t i = s->corners[n];
    const uint16_t corner = (uint16_t)(i < vertices ? i : named[i - vertices]);
    if (bytes == 1) at[0] = (unsigned char)corner;
    if (bytes == 2) memcpy(at, &corner, 2);
    at += bytes;
  }
  at += nsvcd__numbers_write(s, from, at);
  f->first_vertex[to + 1] = f->first_vertex[to] + vertices;
  f->first_triangle[to + 1] = f->first_triangle[to] + (uint32_t)(end - first);
  f->first_byte[to + 1] = f->first_byte[to] + (uint32_t)(at - begin);
}

// Writes the seeds group by group (counting sort). order: of the patches.
static void nsvcd__seeds_write(const nsvcd__writer *w, const uint16_t *order) {
  const nsvcd__surface *s = w->surface;
  const nsvcd__geometry *f = &w->to;
  uint32_t *first = f->first_seed;
  // the numbers of patches in the body, for now in place of their first vertices
  uint32_t *numbers = f->first_vertex;
  const size_t patches = f->body->patches;
  const size_t groups = nsvcd__body_groups(f->body);
  for (size_t i = 0; i < patches; i++) numbers[order[i]] = (uint32_t)i;
  for (size_t n = 0; n < s->seed_count; n++)
    first[numbers[s->seed_patches[n]] / NSVCD__GROUP + 1]++;
  for (size_t g = 0; g < groups; g++) first[g + 1] += first[g];
  for (size_t n = s->seed_count; n-- > 0;) {
    const size_t to = --first[numbers[s->seed_patches[n]] / NSVCD__GROUP + 1];
    nsvcd__f3_store(s->seeds[n], f->seeds + 3 * to);
  }
  // now first[g + 1] is where group g begins
  memmove(first, first + 1, groups * sizeof *first);
  first[groups] = (uint32_t)s->seed_count;
  memset(numbers, 0, patches * sizeof *numbers);
}

// Writes the balls, a coarse body's larger by what its surface is off the mesh.
static void nsvcd__balls_write(nsvcd__writer *w) {
  const nsvcd__geometry *f = &w->to;
  const nsvcd__ball_cover *cover = &w->cover;
  float off = 0;
  for (size_t i = 0; i < f->body->patches && w->surface->coarse; i++)
    off = f->errors[i] > off ? f->errors[i] : off;
  const size_t slots = nsvcd__round_up(cover->count, NSVCD__GROUP);
  for (size_t n = 0; n < slots; n++) {
    nsvcd__sphere ball = {{0, 0, 0}, NSVCD__NOWHERE};
    if (n < cover->count) {
      ball.centre = cover->centres[n];
      ball.radius = nsvcd__above((double)cover->radii[n] + (double)off);
    }
    nsvcd__sphere_store(ball, f->balls, slots, n);
  }
  if (cover->count > 0)
    f->counts->ball_error = nsvcd__above((double)cover->error + 2 * (double)off);
  nsvcd__cover_balls(f);
}

// Builds a body of triangles of `size` bytes in `memory`, and uses up the writer. order: (N) of the
// patches. NUMBER if it is too large, EMPTY if it is too small.
static nsvcd_result nsvcd__geometry_build(nsvcd__writer *w, const uint16_t *order, int open,
                                          void *memory, size_t size) {
  const nsvcd__surface *s = w->surface;
  const nsvcd__counts *counts = &w->counts;
  nsvcd_body *b = nsvcd__body_begin(memory, size, s->count, open);
  b->triangles = (uint32_t)w->mesh->triangle_count;
  (void)nsvcd__geometry_layout(b, s->count, counts, &w->to);
  *w->to.counts = *counts;
  nsvcd__seeds_write(w, order);
  for (size_t i = 0; i < s->count; i++) nsvcd__patch_write(w, order[i], i);
  if (!s->coarse) nsvcd__cut_write(w);
  nsvcd__balls_write(w);
  if (!nsvcd__in_range(nsvcd__body_r(b), b->patches, 4 * NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  nsvcd__geometry_finish(b, 0);
  return b->radius + counts->convex_radius < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER
