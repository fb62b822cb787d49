// In: the sizes of a shape. Out: its body: a skeleton of points, segments or a box, and a convex
// radius.
#pragma once
#include "encode.h"

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
static nsvcd_result nsvcd__encode_rounded(const nsvcd_mesh *mesh, float convex_radius,
                                          const nsvcd_allocator *alloc,
                                          const nsvcd_body **body) {
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.convex_radius = convex_radius;
  return nsvcd__encode_mesh(mesh, &options, alloc, NULL, 0, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_sphere(float radius, const nsvcd_allocator *alloc,
                                          const nsvcd_body **body) {
  float centre[3] = {0, 0, 0};
  uint32_t point[3] = {0, 0, 0};
  const nsvcd_mesh mesh = {centre, point, 1, 1};
  if (!(radius > 0)) return NSVCD_ERROR_RADIUS;
  return nsvcd__encode_rounded(&mesh, radius, alloc, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_capsule(const float from[3], const float to[3],
                                           float radius, const nsvcd_allocator *alloc,
                                           const nsvcd_body **body) {
  float ends[6];
  uint32_t segment[3] = {0, 1, 1};
  const nsvcd_mesh mesh = {ends, segment, 2, 1};
  if (!from || !to) return NSVCD_ERROR_ARGUMENT;
  if (!(radius > 0)) return NSVCD_ERROR_RADIUS;
  memcpy(ends, from, 3 * sizeof *from);
  memcpy(ends + 3, to, 3 * sizeof *to);
  return nsvcd__encode_rounded(&mesh, radius, alloc, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_box(const float half[3], float convex_radius,
                                       const nsvcd_allocator *alloc, const nsvcd_body **body) {
  // bit k of a corner's number: it is on the positive side of axis k
  uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  float corners[24];
  const nsvcd_mesh mesh = {corners, faces, 8, 12};
  if (!half) return NSVCD_ERROR_ARGUMENT;
  if (!(convex_radius >= 0)) return NSVCD_ERROR_RADIUS;
  for (size_t k = 0; k < 3; k++) {
    if (!(half[k] > 0) || !(half[k] >= convex_radius)) return NSVCD_ERROR_RADIUS;
    for (size_t n = 0; n < 8; n++)
      corners[3 * n + k] = n >> k & 1 ? half[k] - convex_radius : convex_radius - half[k];
  }
  return nsvcd__encode_rounded(&mesh, convex_radius, alloc, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_cloud(const float *points, size_t count, float radius,
                                         const nsvcd_allocator *alloc,
                                         const nsvcd_body **body) {
  nsvcd_mesh mesh = {NULL, NULL, count, count};
  if (!points) return NSVCD_ERROR_ARGUMENT;
  if (!(radius > 0)) return NSVCD_ERROR_RADIUS;
  if (count == 0) return NSVCD_ERROR_EMPTY;
  if (count > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  if (!nsvcd__in_range(points, 3 * count, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  // a cast would take away a const; nothing is written
  memcpy(&mesh.positions, &points, sizeof points);
  return nsvcd__encode_rounded(&mesh, radius, alloc, body);
}
#endif
