// In: triangles. Out: nsvcd_mesh, every index in range, every coordinate finite; the part of one
// in a box.
#pragma once
#include "../ground/valid.h"
#include "../ground/memory.h"

#ifndef NSVCD_NO_ENCODER
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *alloc) {
  if (!mesh) return;
  nsvcd__free(alloc, mesh->positions);
  nsvcd__free(alloc, mesh->indices);
  memset(mesh, 0, sizeof *mesh);
}

// Allocates vertices and triangles. 0 without memory. Free it with nsvcd_mesh_free, on failure too.
static int nsvcd__mesh_alloc(nsvcd_mesh *mesh, size_t vertices, size_t triangles,
                             const nsvcd_allocator *alloc) {
  const size_t row = 3 * sizeof(float);
  mesh->vertex_count = vertices;
  mesh->triangle_count = triangles;
  // + 1: a file may hold faces and no vertex, and malloc(0) may return NULL.
  mesh->positions = (float *)nsvcd__alloc_array(alloc, vertices + 1, row);
  mesh->indices = (uint32_t *)nsvcd__alloc_array(alloc, triangles, row);
  return mesh->positions && mesh->indices;
}

// The box of the triangles of a mesh with indices.
static void nsvcd__mesh_box(const nsvcd_mesh *mesh, nsvcd__d3 *low, nsvcd__d3 *high) {
  *low = *high = nsvcd__d3_row(mesh->positions, mesh->indices[0]);
  for (size_t n = 0; n < 3 * mesh->triangle_count; n++) {
    *low = nsvcd__d3_min(*low, nsvcd__d3_row(mesh->positions, mesh->indices[n]));
    *high = nsvcd__d3_max(*high, nsvcd__d3_row(mesh->positions, mesh->indices[n]));
  }
}

// A triangle cut at the six sides of a box. Each side adds one corner, or two if roundings make the
// polygon cross it twice.
typedef struct nsvcd__clipped {
  nsvcd__d3 corners[3 + 2 * 6];
  size_t count;
} nsvcd__clipped;

// The part of triangle t in a box (Sutherland, Hodgman 1974): 0, or 3 to 9 corners, but for
// roundings.
static nsvcd__clipped nsvcd__cut_triangle(const nsvcd_mesh *mesh, size_t t, const float *low,
                                          const float *high) {
  const uint32_t *triangle = mesh->indices + 3 * t;
  nsvcd__clipped out;
  for (out.count = 0; out.count < 3; out.count++)
    out.corners[out.count] = nsvcd__d3_row(mesh->positions, triangle[out.count]);
  for (size_t side = 0; side < 6; side++) {
    const size_t axis = side / 2;
    const double sign = side % 2 ? 1 : -1;
    const double bound = (double)(side % 2 ? high : low)[axis];
    const nsvcd__clipped from = out;
    out.count = 0;
    // keeps sign * x[axis] <= sign * bound
    for (size_t i = 0; i < from.count; i++) {
      const nsvcd__d3 a = from.corners[i];
      const nsvcd__d3 b = from.corners[(i + 1) % from.count];
      const double past_a = sign * (nsvcd__d3_axis(a, axis) - bound);
      const double past_b = sign * (nsvcd__d3_axis(b, axis) - bound);
      if (past_a <= 0) out.corners[out.count++] = a;
      if ((past_a <= 0) == (past_b <= 0)) continue;
      nsvcd__d3 *between = &out.corners[out.count++];
      *between = nsvcd__d3_mix(a, b, past_a / (past_a - past_b));
      nsvcd__d3_set_axis(between, axis, bound);
    }
    if (side % 2 && out.count < 3) out.count = 0;
  }
  return out;
}

NSVCDDEF nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *mesh, const float low[3],
                                     const float high[3], const nsvcd_allocator *alloc,
                                     nsvcd_mesh *part) {
  if (!low || !high || !part) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 3; k++) {
    if (!nsvcd__is_finite(low[k]) || !nsvcd__is_finite(high[k]) || !(low[k] < high[k]))
      return NSVCD_ERROR_BOX;
  }
  const nsvcd_result result = nsvcd__mesh_check(mesh);
  if (result) return result;

  size_t vertices = 0;
  size_t triangles = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const size_t corners = nsvcd__cut_triangle(mesh, t, low, high).count;
    vertices += corners;
    triangles += corners ? corners - 2 : 0;
  }
  if (vertices == 0) return NSVCD_ERROR_EMPTY;
  if (vertices > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  nsvcd_mesh out;
  if (!nsvcd__mesh_alloc(&out, vertices, triangles, alloc)) {
    nsvcd_mesh_free(&out, alloc);
    return NSVCD_ERROR_MEMORY;
  }

  out.vertex_count = 0;
  out.triangle_count = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__clipped polygon = nsvcd__cut_triangle(mesh, t, low, high);
    const uint32_t first = (uint32_t)out.vertex_count;
    for (size_t i = 0; i < polygon.count; i++) {
      const nsvcd__f3 corner = nsvcd__d3_narrow(polygon.corners[i]);
      nsvcd__f3_store(corner, out.positions + 3 * out.vertex_count++);
    }
    // a fan
    for (uint32_t i = 2; i < polygon.count; i++) {
      uint32_t *triangle = out.indices + 3 * out.triangle_count++;
      triangle[0] = first;
      triangle[1] = first + i - 1;
      triangle[2] = first + i;
    }
  }
  *part = out;
  return NSVCD_OK;
}
#endif
