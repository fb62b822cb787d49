// mesh_kinds.h - meshes of many kinds: boxes, plates, needles, a torus, soup, a fan of slivers. After
// the implementation.
#ifndef NSVCD_TESTS_MESH_KINDS_H
#define NSVCD_TESTS_MESH_KINDS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_of.h"

static uint64_t mesh_rng = 1;

static uint32_t mesh_random(void) {  // splitmix64
  uint64_t z = (mesh_rng += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (uint32_t)((z ^ (z >> 31)) >> 32);
}

static size_t mesh_below(size_t n) {
  return (size_t)mesh_random() % n;
}

static double mesh_uniform(double low, double high) {
  return low + (high - low) * (double)mesh_random() / 4294967296.0;
}

static double vector_length(const double *v) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// The corners of triangle t, its area vector and its area.
static double mesh_triangle(const nsvcd_mesh *mesh, size_t t, double corners[3][3],
                            double *vector) {
  const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
  const nsvcd__d3 v = nsvcd__area_vector(&triangle);
  const double out[3] = {v.x, v.y, v.z};
  memcpy(corners, &triangle, sizeof triangle);
  memcpy(vector, out, sizeof out);
  return nsvcd__triangle_area(&triangle);
}

// As vectors.
static nsvcd__f3 *mesh_f3s(float *numbers) {
  return (nsvcd__f3 *)(void *)numbers;
}

static void mesh_area_vector(const nsvcd_mesh *mesh, double *sum) {
  sum[0] = sum[1] = sum[2] = 0;
  for (size_t t = 0; t < mesh->triangle_count; ++t) {
    double corners[3][3], v[3];
    mesh_triangle(mesh, t, corners, v);
    for (int k = 0; k < 3; ++k) sum[k] += v[k];
  }
}

// A closed surface of rings x segments quads around a torus (tube > 0), or a lumpy sphere (tube 0,
// poles are degenerate).
static nsvcd_mesh mesh_round(size_t rings, size_t segments, double radius, double tube) {
  nsvcd_mesh mesh = mesh_new(rings * segments, 2 * rings * segments);
  const double pi = 3.14159265358979323846;
  uint32_t *index = mesh.indices;
  for (size_t i = 0; i < rings; ++i) {
    for (size_t j = 0; j < segments; ++j) {
      double a =
          tube > 0 ? 2 * pi * (double)i / (double)rings : pi * (double)i / (double)(rings - 1);
      double b = 2 * pi * (double)j / (double)segments;
      double r =
          tube > 0 ? radius + tube * cos(a) : radius * sin(a) * (1 + 0.3 * cos(3 * b) * sin(a));
      if (tube <= 0 && (i == 0 || i == rings - 1)) r = 0;  // exact poles close the surface
      float *p = mesh.positions + 3 * (i * segments + j);
      p[0] = (float)(r * cos(b));
      p[1] = (float)(r * sin(b));
      p[2] = (float)(tube > 0 ? tube * sin(a) : -radius * cos(a));
      if (tube <= 0 && i == rings - 1) {  // no quads beyond the last ring: points
        for (int k = 0; k < 6; ++k) *index++ = (uint32_t)(i * segments + j);
        continue;
      }
      uint32_t i1 = (uint32_t)((i + 1) % rings);
      uint32_t j1 = (uint32_t)((j + 1) % segments);
      uint32_t s = (uint32_t)segments;
      uint32_t v00 = (uint32_t)(i * segments + j);
      uint32_t v01 = (uint32_t)i * s + j1;
      uint32_t v10 = i1 * s + (uint32_t)j;
      uint32_t v11 = i1 * s + j1;
      *index++ = v00, *index++ = v01, *index++ = v11;
      *index++ = v00, *index++ = v11, *index++ = v10;
    }
  }
  return mesh;
}

static nsvcd_mesh mesh_box(double x, double y, double z) {
  static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  nsvcd_mesh mesh = mesh_new(8, 12);
  for (int i = 0; i < 8; ++i) {
    float *p = mesh.positions + 3 * i;
    p[0] = (float)(i & 1 ? x : -x);
    p[1] = (float)(i & 2 ? y : -y);
    p[2] = (float)(i & 4 ? z : -z);
  }
  memcpy(mesh.indices, faces, sizeof faces);
  return mesh;
}

// random triangles, some tiny, some slivers, some points
static nsvcd_mesh mesh_shards(size_t triangles, double size) {
  nsvcd_mesh mesh = mesh_new(3 * triangles, triangles);
  for (size_t i = 0; i < 3 * triangles; ++i) {
    double scale = i % 9 < 3 ? 1 : 0.05;
    for (size_t k = 0; k < 3; ++k) {
      double base = i % 3 ? (double)mesh.positions[3 * (i - i % 3) + k] : mesh_uniform(-size, size);
      mesh.positions[3 * i + k] = (float)(base + (i % 3 ? size * scale * mesh_uniform(-1, 1) : 0));
    }
    mesh.indices[i] = (uint32_t)i;
  }
  // no area
  for (size_t t = 0; t + 1 < triangles; t += 11) mesh.indices[3 * t + 1] = mesh.indices[3 * t];
  return mesh;
}

// slivers from one point: an open strip
static nsvcd_mesh mesh_fan(size_t triangles, double length, double width) {
  nsvcd_mesh mesh = mesh_new(triangles + 2, triangles);
  for (size_t i = 0; i <= triangles; ++i) {
    mesh.positions[3 * i] = (float)length;
    mesh.positions[3 * i + 1] = (float)(width * (double)i / (double)triangles);
  }
  for (size_t t = 0; t < triangles; ++t) {
    mesh.indices[3 * t] = (uint32_t)triangles + 1;
    mesh.indices[3 * t + 1] = (uint32_t)t;
    mesh.indices[3 * t + 2] = (uint32_t)t + 1;
  }
  return mesh;
}

static void mesh_scale(nsvcd_mesh *mesh, float s) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; ++i) mesh->positions[i] *= s;
}

static void mesh_move(nsvcd_mesh *mesh, float d) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; ++i) mesh->positions[i] += d;
}

enum { MESH_KINDS = 9 };

static nsvcd_mesh mesh_kind(int kind) {
  nsvcd_mesh mesh;
  switch (kind) {
    case 0:
      return mesh_box(0.1, 0.08, 0.06);
    case 1:
      return mesh_box(0.2, 0.2, 0.001);  // a thin plate
    case 2:
      return mesh_round(40, 60, 0.1, 0.03);  // a torus
    case 3:
      return mesh_round(33, 48, 0.12, 0);  // a lumpy sphere
    case 4:
      return mesh_shards(300, 0.15);
    case 5:
      return mesh_fan(200, 1, 0.05);
    case 6:
      return mesh_box(1, 1e-4, 1e-4);  // a needle
    case 7:
      mesh = mesh_round(20, 30, 0.1, 0.04);
      mesh_move(&mesh, 500);
      return mesh;  // far from the origin
    default:
      mesh = mesh_round(90, 120, 0.1, 0.05);
      mesh_scale(&mesh, 1e-3f);
      return mesh;
  }
}

static const int mesh_kind_closed[MESH_KINDS] = {1, 1, 1, 1, 0, 0, 1, 1, 1};

#endif
