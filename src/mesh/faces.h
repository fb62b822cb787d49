// In: faces of any number of corners, from an engine or another reader. Out: nsvcd_mesh.
#pragma once
#include "mesh.h"
#include "polygons.h"

#ifndef NSVCD_NO_READERS
// Checks the faces. *triangles: how many they become; *most: corners of the largest.
static nsvcd_result nsvcd__faces_check(const nsvcd_faces *f, size_t *triangles,
                                       uint32_t *most) {
  size_t corners = 0;
  *triangles = 0;
  *most = 0;
  for (size_t n = 0; n < f->face_count; n++) {
    const uint32_t size = f->sizes ? f->sizes[n] : 3;
    if (size < 3 || size > f->corner_count - corners) return NSVCD_ERROR_SIZES;
    corners += size;
    *triangles += size - 2;
    if (size > *most) *most = size;
  }
  if (corners != f->corner_count) return NSVCD_ERROR_SIZES;
  if (f->vertex_count > NSVCD__MAX_COUNT || *triangles > NSVCD__MAX_COUNT)
    return NSVCD_ERROR_TOO_LARGE;
  for (size_t i = 0; i < corners; i++) {
    if (f->corners[i] >= f->vertex_count) return NSVCD_ERROR_INDEX;
  }
  if (!nsvcd__in_range(f->positions, 3 * f->vertex_count, NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  return *triangles ? NSVCD_OK : NSVCD_ERROR_EMPTY;
}

NSVCDDEF nsvcd_result nsvcd_mesh_of_faces(const nsvcd_faces *f, const nsvcd_allocator *alloc,
                                          nsvcd_mesh *mesh) {
  nsvcd_mesh out;
  nsvcd__polygon polygon;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  size_t triangles;
  uint32_t most;
  if (!f || !mesh) return NSVCD_ERROR_ARGUMENT;
  if ((f->vertex_count && !f->positions) || (f->corner_count && !f->corners))
    return NSVCD_ERROR_ARGUMENT;
  nsvcd_result result = nsvcd__faces_check(f, &triangles, &most);
  if (result) return result;
  if (!nsvcd__mesh_alloc(&out, f->vertex_count, triangles, alloc) ||
      !nsvcd__polygon_alloc(&polygon, most, &arena)) {
    nsvcd__arena_free(&arena);
    nsvcd_mesh_free(&out, alloc);
    return NSVCD_ERROR_MEMORY;
  }
  memcpy(out.positions, f->positions, 3 * f->vertex_count * sizeof(float));
  const uint32_t *corner = f->corners;
  uint32_t *triangle = out.indices;
  for (size_t n = 0; n < f->face_count; n++) {
    polygon.count = f->sizes ? f->sizes[n] : 3;
    for (uint32_t i = 0; i < polygon.count; i++) polygon.corners[i].vertex = *corner++;
    nsvcd__polygon_triangulate(&polygon, out.positions, triangle);
    triangle += 3 * (size_t)(polygon.count - 2);
  }
  nsvcd__arena_free(&arena);
  *mesh = out;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_READERS
