// In: the triangles of a mesh's components that are not closed. Out: which of them share each edge,
// after corners at edges that lack a triangle have been joined to others that are near enough, and
// triangles that are there twice or have equal corners have been set aside.
#pragma once
#include "samples.h"
#include "topology.h"

#ifndef NSVCD_NO_ENCODER
// Corners are joined up to this distance, as a fraction of the diagonal of the mesh's box, and of
// the longest edge at either.
#define NSVCD__JOINED 1e-4
#define NSVCD__JOINED_OF_EDGE 0.01
// vertices that are tried in a cell
#define NSVCD__JOIN_TRIES 64

// The triangles of components that are not closed, without those that are points or segments.
typedef struct nsvcd__mending {
  const nsvcd__topology *topo;
  size_t count;  // T
  // (T) of the mesh
  uint32_t *triangles;
  // (vertices) what a welded vertex was joined to, or itself
  uint32_t *joined;
  uint8_t *alive;  // (T) 0: set aside
  // (3 T) where an edge begins: edge k of triangle n is 3 n + k, and ends where the next one begins
  uint32_t *corners;
  // (3 T) edges, sorted by their ends
  uint32_t *order;
  // E groups of edges with the same ends: (3 T) the group of each edge; (E + 1) where a group
  // begins in `order`
  uint32_t *groups, *group_first;
  size_t group_count;
  // (E) how many alive triangles have this edge, and the exclusive or of their numbers
  uint32_t *degrees, *others;
  // (T) union-find forests: of all triangles that edges join, and of the alive ones
  uint32_t *wholes, *parts;
  // (vertices + 1) working memory
  size_t *first;
  // (3 T) working memory
  uint32_t *spare;
} nsvcd__mending;

static nsvcd__triangle nsvcd__mending_triangle(const nsvcd__mending *m, size_t n) {
  return nsvcd__triangle_of(m->topo->mesh, m->triangles[n]);
}

// The ends of an edge, the lesser first. rises: 1: its triangle goes from that to the other.
typedef struct nsvcd__edge {
  uint32_t ends[2];
  int rises;
} nsvcd__edge;

static nsvcd__edge nsvcd__mending_edge(const nsvcd__mending *m, size_t e) {
  const uint32_t from = m->corners[e];
  const uint32_t to = m->corners[e % 3 == 2 ? e - 2 : e + 1];
  const nsvcd__edge out = {{from < to ? from : to, from < to ? to : from}, from < to};
  return out;
}

// Is edge e the only one of an alive triangle at its ends?
static int nsvcd__is_border(const nsvcd__mending *m, size_t e) {
  return m->alive[e / 3] && m->degrees[m->groups[e]] == 1;
}

// Sorts edges by one of their ends. Counting sort: equal ones keep their order.
static void nsvcd__sort_edges(nsvcd__mending *m, const uint32_t *from, uint32_t *to,
                              size_t which) {
  const size_t vertices = m->topo->mesh->vertex_count;
  memset(m->first, 0, (vertices + 1) * sizeof *m->first);
  for (size_t e = 0; e < 3 * m->count; e++)
    m->first[nsvcd__mending_edge(m, e).ends[which] + 1]++;
  for (size_t v = 0; v < vertices; v++) m->first[v + 1] += m->first[v];
  for (size_t i = 0; i < 3 * m->count; i++)
    to[m->first[nsvcd__mending_edge(m, from[i]).ends[which]]++] = from[i];
}

// Counts the alive triangles at each edge.
static void nsvcd__count_degrees(nsvcd__mending *m) {
  memset(m->degrees, 0, m->group_count * sizeof *m->degrees);
  memset(m->others, 0, m->group_count * sizeof *m->others);
  for (size_t e = 0; e < 3 * m->count; e++) {
    if (!m->alive[e / 3]) continue;
    m->degrees[m->groups[e]]++;
    m->others[m->groups[e]] ^= (uint32_t)(e / 3);
  }
}

// Groups equal edges, and sets aside triangles that are there twice or have equal corners.
static void nsvcd__group_edges(nsvcd__mending *m) {
  uint32_t *seen = m->parts;
  nsvcd__edge last = {{0, 0}, 0};
  m->group_count = 0;
  for (size_t n = 0; n < m->count; n++) {
    uint32_t *face = m->corners + 3 * n;
    nsvcd__welded_face(m->topo, m->triangles[n], face);
    for (size_t k = 0; k < 3; k++) face[k] = m->joined[face[k]];
    m->alive[n] = (uint8_t)nsvcd__are_distinct(face);
  }
  for (size_t e = 0; e < 3 * m->count; e++) m->order[e] = (uint32_t)e;
  nsvcd__sort_edges(m, m->order, m->spare, 1);
  nsvcd__sort_edges(m, m->spare, m->order, 0);
  for (size_t i = 0; i < 3 * m->count; i++) {
    const nsvcd__edge edge = nsvcd__mending_edge(m, m->order[i]);
    if (i == 0 || edge.ends[0] != last.ends[0] || edge.ends[1] != last.ends[1])
      m->group_first[m->group_count++] = (uint32_t)i;
    last = edge;
    m->groups[m->order[i]] = (uint32_t)(m->group_count - 1);
  }
  m->group_first[m->group_count] = (uint32_t)(3 * m->count);
  // Equal triangles share the edge between their two least corners, and the third corner.
  memset(m->first, 0, m->topo->mesh->vertex_count * sizeof *m->first);
  for (size_t g = 0; g < m->group_count; g++) {
    size_t met = 0;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      const size_t n = m->order[i] / 3;
      const uint32_t third = m->corners[3 * n + (m->order[i] + 2) % 3];
      const nsvcd__edge edge = nsvcd__mending_edge(m, m->order[i]);
      if (!m->alive[n] || third < edge.ends[1]) continue;
      m->alive[n] = m->first[third] == 0;
      m->first[third] = 1;
      seen[met++] = third;
    }
    while (met > 0) m->first[seen[--met]] = 0;
  }
  nsvcd__count_degrees(m);
}

// ---- corners that are near each other

// A hash table of vertices by cell.
typedef struct nsvcd__cells {
  const nsvcd__mending *m;
  nsvcd__d3 low;
  double width;
  // (slots) the last vertex of a slot + 1, or 0; (vertices) the one before it, likewise
  uint32_t *heads, *before;
  size_t slots;
  // (vertices) metres: how far it may be joined; 0: it is at no edge that lacks a triangle
  float *limits;
} nsvcd__cells;

static uint32_t *nsvcd__cell_of(const nsvcd__cells *c, const double *cell) {
  uint32_t hash = 0;
  for (size_t k = 0; k < 3; k++) {
    hash = (hash ^ (uint32_t)(int64_t)cell[k]) * 0x9e3779b1u;
    hash ^= hash >> 15;
  }
  return &c->heads[(hash * 0x85ebca6bu) & (c->slots - 1)];
}

// Joins a vertex to the nearest one in the table that is near enough, or puts it there itself.
// Returns the distance joined.
static double nsvcd__join_vertex(nsvcd__cells *c, uint32_t v) {
  const float *positions = c->m->topo->mesh->positions;
  const nsvcd__d3 at = nsvcd__d3_row(positions, v);
  const nsvcd__d3 off = nsvcd__d3_scale(nsvcd__d3_sub(at, c->low), 1 / c->width);
  double own[3], side[3];
  double best = HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    const double x = nsvcd__d3_axis(off, k);
    own[k] = floor(x);
    side[k] = x - own[k] < 0.5 ? -1 : 1;
  }
  for (int corner = 0; corner < 8; corner++) {
    double cell[3];
    for (int k = 0; k < 3; k++) cell[k] = own[k] + (corner >> k & 1 ? side[k] : 0);
    uint32_t w = *nsvcd__cell_of(c, cell);
    for (size_t tries = 0; w && tries < NSVCD__JOIN_TRIES; tries++) {
      const double limit = (double)fminf(c->limits[v], c->limits[w - 1]);
      const double square = nsvcd__d3_distance2(at, nsvcd__d3_row(positions, w - 1));
      if (square <= limit * limit && square < best) {
        best = square;
        c->m->joined[v] = w - 1;
      }
      w = c->before[w - 1];
    }
  }
  if (best < HUGE_VAL) return sqrt(best);
  uint32_t *head = nsvcd__cell_of(c, own);
  c->before[v] = *head;
  *head = v + 1;
  return 0;
}

// Sets how far the vertices at edges of an odd number of triangles may be joined, `most` at most.
// Returns how many they are.
static size_t nsvcd__find_limits(const nsvcd__mending *m, double most, float *limits) {
  size_t count = 0;
  for (size_t e = 0; e < 3 * m->count; e++) {
    if (m->degrees[m->groups[e]] % 2 == 0) continue;
    const nsvcd__triangle t = nsvcd__mending_triangle(m, e / 3);
    const nsvcd__edge edge = nsvcd__mending_edge(m, e);
    const double length = sqrt(nsvcd__d3_distance2(t.at[e % 3], t.at[(e + 1) % 3]));
    const float own = (float)nsvcd__min(most, NSVCD__JOINED_OF_EDGE * length);
    for (size_t k = 0; k < 2; k++) {
      float *limit = &limits[edge.ends[k]];
      count += *limit <= 0;
      *limit = fmaxf(own, *limit);
    }
  }
  return count;
}

// Joins corners that are near enough to each other. Returns the greatest distance joined, or -1
// without memory.
static double nsvcd__join_corners(nsvcd__mending *m, const nsvcd_allocator *alloc) {
  const nsvcd_mesh *mesh = m->topo->mesh;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  nsvcd__d3 low = nsvcd__d3_row(mesh->positions, 0);
  nsvcd__d3 high = low;
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    low = nsvcd__d3_min(low, nsvcd__d3_row(mesh->positions, mesh->indices[i]));
    high = nsvcd__d3_max(high, nsvcd__d3_row(mesh->positions, mesh->indices[i]));
  }
  const double most = NSVCD__JOINED * sqrt(nsvcd__d3_distance2(low, high));
  double widest = 0;
  nsvcd__cells c;
  memset(&c, 0, sizeof c);
  c.m = m;
  c.low = low;
  c.width = 2 * most;
  c.limits = NSVCD__TAKE(&arena, float, mesh->vertex_count);
  const size_t left = c.limits ? nsvcd__find_limits(m, most, c.limits) : 0;
  for (c.slots = 16; c.slots / 2 < left;) c.slots *= 2;
  c.heads = NSVCD__TAKE(&arena, uint32_t, c.slots);
  c.before = NSVCD__TAKE(&arena, uint32_t, mesh->vertex_count);
  for (uint32_t v = 0; !arena.failed && v < mesh->vertex_count; v++) {
    if (c.limits[v] > 0) widest = nsvcd__max(widest, nsvcd__join_vertex(&c, v));
  }
  nsvcd__arena_free(&arena);
  return arena.failed ? -1 : widest;
}

// Groups the edges of `m` and joins corners, of the triangles and the topology that stand in it. 0
// without memory.
static int nsvcd__mending_build(nsvcd__mending *m, nsvcd__arena *arena) {
  const size_t vertices = m->topo->mesh->vertex_count;
  const size_t count = m->count;
  m->joined = NSVCD__TAKE(arena, uint32_t, vertices);
  m->alive = NSVCD__TAKE(arena, uint8_t, count);
  m->corners = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->order = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->groups = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->group_first = NSVCD__TAKE(arena, uint32_t, 3 * count + 1);
  m->degrees = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->others = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->wholes = NSVCD__TAKE(arena, uint32_t, count);
  m->parts = NSVCD__TAKE(arena, uint32_t, count);
  m->first = NSVCD__TAKE(arena, size_t, vertices + 1);
  m->spare = NSVCD__TAKE(arena, uint32_t, 3 * count);
  if (arena->failed) return 0;
  for (uint32_t v = 0; v < vertices; v++) m->joined[v] = v;
  nsvcd__group_edges(m);
  const double widest = nsvcd__join_corners(m, arena->allocator);
  if (widest < 0) return 0;
  if (widest > 0) nsvcd__group_edges(m);
  return 1;
}
#endif  // NSVCD_NO_ENCODER
