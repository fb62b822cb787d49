// mesh_of.h - a shape of examples/scenery/shapes.h as the library takes it. After nsvcd_mesh.
#ifndef NSVCD_TESTS_MESH_OF_H
#define NSVCD_TESTS_MESH_OF_H

#include <stdlib.h>
#include <string.h>

#include "../examples/scenery/shapes.h"

SHAPES_DEF nsvcd_mesh mesh_new(size_t vertices, size_t triangles) {
  nsvcd_mesh mesh;
  mesh.positions = (float *)calloc(3 * vertices + 1, sizeof(float));
  mesh.indices = (uint32_t *)calloc(3 * triangles + 1, sizeof(uint32_t));
  mesh.vertex_count = vertices;
  mesh.triangle_count = triangles;
  if (!mesh.positions || !mesh.indices) exit(1);
  return mesh;
}

// Rounds the shape's positions, too: the oracle's mesh of the same shape is the same mesh.
SHAPES_DEF nsvcd_mesh mesh_of(shapes_mesh *shape) {
  nsvcd_mesh mesh = mesh_new(shape->vertices, shape->triangles);
  if (shape->failed) exit(1);
  for (size_t i = 0; i < 3 * shape->vertices; i++) {
    mesh.positions[i] = (float)shape->positions[i];
    shape->positions[i] = (double)mesh.positions[i];
  }
  memcpy(mesh.indices, shape->indices, 3 * shape->triangles * sizeof(uint32_t));
  return mesh;
}

#endif
