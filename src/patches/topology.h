// In: a checked mesh. Out: its topology: vertices at the same position are one, triangles that
// share vertices are one component, and a component is closed or not.
#pragma once
#include "../mesh/weld.h"

#ifndef NSVCD_NO_ENCODER
// Of the vertices at one position the first stands for all. A component is named by its root, its
// least vertex.
typedef struct nsvcd__topology {
  const nsvcd_mesh *mesh;
  size_t component_count;
  // (vertices) the first vertex at the same position
  uint32_t *welded;
  // (vertices) a union-find forest; once built, the root
  uint32_t *parents;
  // (vertices) 1 at a root: its component is not closed
  uint8_t *open;
  // (vertices) 1 at a root: it has a triangle
  uint8_t *seen;
} nsvcd__topology;

static void nsvcd__welded_face(const nsvcd__topology *topo, size_t t, uint32_t *face) {
  const uint32_t *corners = topo->mesh->indices + 3 * t;
  face[0] = topo->welded[corners[0]];
  face[1] = topo->welded[corners[1]];
  face[2] = topo->welded[corners[2]];
}

static int nsvcd__are_distinct(const uint32_t *face) {
  return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

static uint32_t nsvcd__root(uint32_t *parents, uint32_t v) {
  while (parents[v] != v) {
    parents[v] = parents[parents[v]];
    v = parents[v];
  }
  return v;
}

// Joins the trees of a and b: the lesser root stays one.
static void nsvcd__join_roots(uint32_t *parents, uint32_t a, uint32_t b) {
  a = nsvcd__root(parents, a);
  b = nsvcd__root(parents, b);
  parents[a > b ? a : b] = a < b ? a : b;
}

// Finds the components that are not closed: those whose directed edges do not cancel. 0 without
// memory.
static int nsvcd__find_open(nsvcd__topology *topo, const nsvcd_allocator *alloc) {
  const nsvcd_mesh *mesh = topo->mesh;
  const size_t vertices = mesh->vertex_count;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  // where the edges begin whose lesser end is a vertex; while they are sorted, one entry further
  size_t *first = NSVCD__TAKE(&arena, size_t, vertices + 2);
  // the greater end
  uint32_t *ends = NSVCD__TAKE(&arena, uint32_t, 3 * mesh->triangle_count);
  // 1: the edge leads to its greater end; -1: from it
  int8_t *signs = NSVCD__TAKE(&arena, int8_t, 3 * mesh->triangle_count);
  // sums of signs by greater end, over the edges of one vertex; else zeros
  int32_t *balances = NSVCD__TAKE(&arena, int32_t, vertices);
  // counting sort of the edges: count, then store
  for (int pass = 0; !arena.failed && pass < 2; pass++) {
    for (size_t t = 0; t < mesh->triangle_count; t++) {
      uint32_t face[3];
      nsvcd__welded_face(topo, t, face);
      // the edges of any other cancel each other
      if (!nsvcd__are_distinct(face)) continue;
      for (size_t k = 0; k < 3; k++) {
        const uint32_t from = face[k];
        const uint32_t to = face[(k + 1) % 3];
        const uint32_t low = from < to ? from : to;
        const size_t e = first[low + 2 - (size_t)pass]++;
        if (pass == 0) continue;
        ends[e] = from < to ? to : from;
        signs[e] = from < to ? 1 : -1;
      }
    }
    for (size_t v = 0; pass == 0 && v < vertices; v++) first[v + 2] += first[v + 1];
  }
  for (size_t v = 0; !arena.failed && v < vertices; v++) {
    for (size_t e = first[v]; e < first[v + 1]; e++) balances[ends[e]] += signs[e];
    for (size_t e = first[v]; e < first[v + 1]; e++) {
      if (balances[ends[e]] != 0) topo->open[topo->parents[v]] = 1;
    }
    for (size_t e = first[v]; e < first[v + 1]; e++) balances[ends[e]] = 0;
  }
  nsvcd__arena_free(&arena);
  return !arena.failed;
}

// 0 without memory.
static int nsvcd__topology_build(const nsvcd_mesh *mesh, nsvcd__arena *arena,
                                 nsvcd__topology *topo) {
  topo->mesh = mesh;
  topo->component_count = 0;
  topo->welded = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count);
  topo->parents = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count);
  topo->open = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  topo->seen = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  if (arena->failed ||
      !nsvcd__weld_all(mesh->positions, mesh->vertex_count, topo->welded, arena->allocator))
    return 0;

  uint32_t *parents = topo->parents;
  uint32_t face[3];
  for (uint32_t v = 0; v < mesh->vertex_count; v++) parents[v] = v;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__welded_face(topo, t, face);
    nsvcd__join_roots(parents, face[0], face[1]);
    nsvcd__join_roots(parents, face[0], face[2]);
  }
  for (uint32_t v = 0; v < mesh->vertex_count; v++) parents[v] = nsvcd__root(parents, v);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__welded_face(topo, t, face);
    topo->component_count += !topo->seen[parents[face[0]]];
    topo->seen[parents[face[0]]] = 1;
  }
  return nsvcd__find_open(topo, arena->allocator);
}
#endif  // NSVCD_NO_ENCODER
