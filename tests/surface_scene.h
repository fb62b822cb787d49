// surface_scene.h - meshes of every kind that an encoder may get, and their components and which of
// them are closed, found by sorting. After the implementation.
#ifndef NSVCD_TESTS_SURFACE_SCENE_H
#define NSVCD_TESTS_SURFACE_SCENE_H

#include "mesh_of.h"

// ------------------------------------------------------------------------------------------ meshes

static nsvcd_mesh surface_take(shapes_mesh *shape) {
  const nsvcd_mesh mesh = mesh_of(shape);
  shapes_free(shape);
  return mesh;
}

// A wavy sheet of cuts * cuts squares; waves 0: flat.
static nsvcd_mesh surface_sheet(size_t cuts, double size, double waves) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  for (size_t j = 0; j <= cuts; j++) {
    for (size_t i = 0; i <= cuts; i++) {
      const double x = (double)i / (double)cuts;
      const double y = (double)j / (double)cuts;
      shapes_vertex(&shape, size * x, size * y, size * waves * sin(5 * x) * cos(7 * y));
    }
  }
  for (uint32_t j = 0; j < cuts; j++) {
    for (uint32_t i = 0; i < cuts; i++) {
      const uint32_t a = j * ((uint32_t)cuts + 1) + i;
      shapes_quad(&shape, a, a + 1, a + (uint32_t)cuts + 2, a + (uint32_t)cuts + 1);
    }
  }
  return surface_take(&shape);
}

// Random triangles of all shapes. Some are points, some segments, some 1:1000.
static nsvcd_mesh surface_soup(shapes_rng *rng, size_t triangles, double size) {
  nsvcd_mesh mesh = mesh_new(3 * triangles, triangles);
  for (size_t t = 0; t < triangles; t++) {
    float *p = mesh.positions + 9 * t;
    for (size_t k = 0; k < 9; k++) {
      const double reach = t % 2 ? 0.05 : 1;
      const double from = k < 3 ? 0 : (double)p[k - 3];
      p[k] = (float)(from + size * reach * shapes_uniform(rng, -0.5, 0.5));
    }
    for (size_t k = 0; k < 3; k++) {
      const double a = (double)p[k];
      const double b = (double)p[3 + k];
      if (t % 7 == 0) p[6 + k] = (float)(a + (b - a) * 0.4 + size * 1e-3 * (k == 0));
      if (t % 11 == 0) p[3 + k] = p[6 + k] = p[k];
      if (t % 13 == 0) p[6 + k] = (float)(0.5 * (a + b));
    }
    for (uint32_t k = 0; k < 3; k++) mesh.indices[3 * t + k] = 3 * (uint32_t)t + k;
  }
  return mesh;
}

static nsvcd_mesh surface_needles(size_t triangles) {  // 1:1000, from one point
  nsvcd_mesh mesh = mesh_new(triangles + 2, triangles);
  for (size_t i = 0; i <= triangles; i++) {
    mesh.positions[3 * i] = 1;
    mesh.positions[3 * i + 1] = 0.001f * (float)i;
  }
  for (uint32_t t = 0; t < triangles; t++) {
    mesh.indices[3 * t] = (uint32_t)triangles + 1;
    mesh.indices[3 * t + 1] = t;
    mesh.indices[3 * t + 2] = t + 1;
  }
  return mesh;
}

static void surface_move(nsvcd_mesh *mesh, double scale, double offset) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
    mesh->positions[i] = (float)(scale * (double)mesh->positions[i] + offset);
  }
}

static nsvcd_mesh surface_twice(nsvcd_mesh mesh) {  // every triangle again
  const size_t bytes = 3 * mesh.triangle_count * sizeof(uint32_t);
  uint32_t *indices = (uint32_t *)malloc(2 * bytes);
  memcpy(indices, mesh.indices, bytes);
  memcpy(indices + 3 * mesh.triangle_count, mesh.indices, bytes);
  free(mesh.indices);
  mesh.indices = indices;
  mesh.triangle_count *= 2;
  return mesh;
}

static nsvcd_mesh surface_box(double x, double y, double z, int cuts) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, x, y, z, cuts);
  return surface_take(&shape);
}

static nsvcd_mesh surface_solid(uint64_t seed, int hollow) {
  shapes_mesh shape;
  shapes_rng rng = {seed};
  memset(&shape, 0, sizeof shape);
  if (hollow) shapes_random_hollow(&shape, &rng, (int)(seed % SHAPES_HOLLOWS), 1);
  if (!hollow) shapes_random_solid(&shape, &rng, 1);
  return surface_take(&shape);
}

static nsvcd_mesh surface_sphere(double radius, int segments) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_ellipsoid(&shape, radius, radius, radius, segments);
  return surface_take(&shape);
}

enum { SURFACE_KINDS = 21 };
static nsvcd_mesh surface_kind(int kind) {
  shapes_rng rng = {77};
  nsvcd_mesh mesh;
  switch (kind) {
    case 0:
      return surface_box(0.4, 0.3, 0.2, 1);
    case 1:
      return surface_box(1, 1, 0.002, 1);
    case 2:
      mesh = surface_box(1, 1, 1, 1);
      mesh.triangle_count = 1;
      return mesh;
    case 3:
      mesh = surface_box(20, 20, 20, 1);  // a plate of 20 m
      mesh.triangle_count = 2;
      return mesh;
    case 4:
      return surface_sheet(1, 1, 0);
    case 5:
      return surface_sheet(40, 1, 0.1);
    case 6:
      return surface_needles(300);
    case 7:
      return surface_soup(&rng, 400, 1);
    case 8:
      return surface_twice(surface_box(0.4, 0.3, 0.2, 3));
    case 9:
      return surface_sphere(0.5, 30);
    case 10:
      mesh = surface_solid(3, 0);
      surface_move(&mesh, 1e-3, 0);
      return mesh;
    case 11:
      mesh = surface_solid(4, 0);
      surface_move(&mesh, 400, 1000);
      return mesh;
    case 12:
      mesh = surface_solid(5, 1);
      surface_move(&mesh, 0.1, 900);  // far from the origin: coordinates have few digits left
      return mesh;
    case 13:
      mesh = surface_soup(&rng, 100, 1);
      surface_move(&mesh, 1e-3, 0);
      return mesh;
    case 14:
    case 15:
    case 16:
      return surface_solid((uint64_t)kind + 10, 0);
    default:
      return surface_solid((uint64_t)kind + 10, 1);
  }
}

static double surface_scale(const nsvcd_mesh *mesh) {
  double scale = 0;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
    scale = fmax(scale, fabs((double)mesh->positions[i]));
  }
  return scale;
}

// ---------------------------------------------------------------------------- topology, by sorting

typedef struct place {
  float p[3];
  uint32_t vertex;
} place;

static int place_order(const void *a, const void *b) {
  const place *x = (const place *)a;
  const place *y = (const place *)b;
  for (size_t k = 0; k < 3; k++) {
    if (x->p[k] < y->p[k]) return -1;
    if (x->p[k] > y->p[k]) return 1;
  }
  return 0;
}

typedef struct edge {
  uint32_t low, high;
  int sign;
} edge;

static int edge_order(const void *a, const void *b) {
  const edge *x = (const edge *)a;
  const edge *y = (const edge *)b;
  if (x->low != y->low) return x->low < y->low ? -1 : 1;
  if (x->high != y->high) return x->high < y->high ? -1 : 1;
  return 0;
}

typedef struct shells {
  uint32_t *part;   // (vertices) the component of a vertex, by a label
  uint8_t *closed;  // (vertices) of a label
  size_t count;     // components with triangles
} shells;

static shells shells_of(const nsvcd_mesh *mesh) {
  const size_t vertices = mesh->vertex_count;
  const size_t triangles = mesh->triangle_count;
  shells out = {(uint32_t *)malloc(4 * vertices), (uint8_t *)malloc(vertices), 0};
  uint32_t *weld = (uint32_t *)malloc(4 * vertices);
  place *places = (place *)malloc(vertices * sizeof *places);
  for (size_t v = 0; v < vertices; v++) {
    memcpy(places[v].p, mesh->positions + 3 * v, 12);
    places[v].vertex = (uint32_t)v;
  }
  qsort(places, vertices, sizeof *places, place_order);
  for (size_t v = 0, first = 0; v < vertices; v++) {
    if (place_order(&places[first], &places[v])) first = v;
    weld[places[v].vertex] = places[first].vertex;
  }

  for (size_t v = 0; v < vertices; v++) out.part[v] = weld[v];
  for (int changed = 1; changed;) {  // the least label of a triangle spreads
    changed = 0;
    for (size_t pass = 0; pass < 2 * triangles; pass++) {
      const size_t t = pass < triangles ? pass : 2 * triangles - 1 - pass;
      uint32_t least = 0xffffffffu;
      for (size_t i = 0; i < 3; i++) {
        const uint32_t label = out.part[weld[mesh->indices[3 * t + i]]];
        least = label < least ? label : least;
      }
      for (size_t i = 0; i < 3; i++) {
        uint32_t *label = &out.part[weld[mesh->indices[3 * t + i]]];
        changed |= *label != least;
        *label = least;
      }
    }
  }
  for (size_t v = 0; v < vertices; v++) out.part[v] = out.part[weld[v]];

  edge *edges = (edge *)malloc(3 * triangles * sizeof *edges);
  size_t count = 0;
  uint8_t *used = (uint8_t *)calloc(vertices, 1);
  for (size_t t = 0; t < triangles; t++) {
    uint32_t c[3];
    for (size_t i = 0; i < 3; i++) c[i] = weld[mesh->indices[3 * t + i]];
    out.count += !used[out.part[c[0]]];
    used[out.part[c[0]]] = 1;
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (size_t i = 0; i < 3; i++) {
      const uint32_t a = c[i];
      const uint32_t b = c[(i + 1) % 3];
      const edge e = {a < b ? a : b, a < b ? b : a, a < b ? 1 : -1};
      edges[count++] = e;
    }
  }
  qsort(edges, count, sizeof *edges, edge_order);
  memset(out.closed, 1, vertices);
  for (size_t e = 0; e < count;) {
    int sum = 0;
    const size_t first = e;
    for (; e < count && !edge_order(&edges[first], &edges[e]); e++) sum += edges[e].sign;
    if (sum) out.closed[out.part[edges[first].low]] = 0;
  }
  free(weld);
  free(places);
  free(edges);
  free(used);
  return out;
}

static void shells_free(shells *s) {
  free(s->part);
  free(s->closed);
}

#endif
