// In: a mesh's topology. Out: what each triangle is part of: a sheet, a closed surface, one that is
// closed but for its winding, or nearly a solid: one with a hole.
//
// A point is inside closed components if they wind about it. That needs a cycle: each directed edge
// has its reverse. A component that is none may contain one, once harmless flaws are set aside, in
// this order, the first two by patches/edges:
//   1. Corners at edges that lack a triangle are joined to others that are near enough.
//   2. Of triangles with the same three corners one stays; those with only two distinct corners go.
//   3. Fins, triangles with an edge that no other has, are set aside, until none is left. So are
//      inner walls: where edges of three meet, the part with the least area.
//   4. What is left is judged part by part (triangles that share edges). It is a cycle; or each
//      edge has an even number of triangles, and then a ray from inside crosses it an odd number of
//      times, however it is wound. Of a sheet nothing is left. A part of the second kind is a sheet
//      if it has less than half the area of all that its edges join: rooms on a terrain are not
//      turned inside out.
//   5. What is still open is a sheet, or nearly a solid: see nsvcd__judge_holes.
// The caller's triangles stay as they are, and are all proven apart. This decides only which of
// them a ray counts.
#pragma once
#include "../ground/spheres.h"
#include "edges.h"

#ifndef NSVCD_NO_ENCODER
// Nearly a solid: its holes have at most this fraction of its area; a hole of three edges counts
// only this fraction of itself.
#define NSVCD__HOLES 0.02
#define NSVCD__HOLE_OF_THREE 0.04
// least mean cosine between a hole and the surface about it, if that goes on across the hole
#define NSVCD__FLUSH 0.25
// a hole is a slit if its area is at most this fraction of its border's length squared
#define NSVCD__SLIT 1e-3

typedef struct nsvcd__solids {
  // (triangles) NSVCD__SHEET and so on
  uint8_t *kinds;
  size_t components, open_components, open_edges;
  // metres: the widest gap that was closed
  double gap;
  // 1: there are kinds other than SHEET and CLOSED
  int is_mixed;
} nsvcd__solids;

// ---- parts

// Makes a forest of the alive triangles, joined by edges with at most `most` of them.
static void nsvcd__join_triangles(const nsvcd__mending *m, uint32_t most, uint32_t *forest) {
  for (size_t n = 0; n < m->count; n++) forest[n] = (uint32_t)n;
  for (size_t g = 0; g < m->group_count; g++) {
    uint32_t last = UINT32_MAX;
    if (m->degrees[g] > most) continue;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      const uint32_t n = m->order[i] / 3;
      if (!m->alive[n]) continue;
      if (last != UINT32_MAX) nsvcd__join_roots(forest, n, last);
      last = n;
    }
  }
  for (size_t n = 0; n < m->count; n++) forest[n] = nsvcd__root(forest, (uint32_t)n);
}

// Sets triangles aside that have an edge which no other has, until none is left.
static void nsvcd__peel(nsvcd__mending *m) {
  uint32_t *waiting = m->spare;
  size_t count = 0;
  for (size_t e = 0; e < 3 * m->count; e++) {
    if (!nsvcd__is_border(m, e)) continue;
    m->alive[e / 3] = 0;
    waiting[count++] = (uint32_t)(e / 3);
  }
  while (count > 0) {
    const uint32_t n = waiting[--count];
    for (size_t k = 0; k < 3; k++) {
      const uint32_t g = m->groups[3 * (size_t)n + k];
      m->others[g] ^= n;
      if (--m->degrees[g] != 1) continue;
      const uint32_t next = m->others[g];
      if (m->alive[next]) waiting[count++] = next;
      m->alive[next] = 0;
    }
  }
}

// What is known of a part; of a whole, all that edges join; or of a wall.
typedef struct nsvcd__shell {
  double area;
  nsvcd__d3 centre;  // times the area
  // edges that have an odd number of triangles; that do not go both ways equally often
  uint32_t odd, turned;
  // of a whole: the area of its parts that enclose something; 1: another part does not
  double closed;
  int fails;
  // of a whole: 1: by its holes it is a sheet; the area of these, and the volume inside
  int is_sheet;
  double holes, volume;
} nsvcd__shell;

// Adds up areas and centres of the alive triangles, by their roots in a forest.
static void nsvcd__sum_areas(const nsvcd__mending *m, const uint32_t *forest,
                             nsvcd__shell *parts) {
  for (size_t n = 0; n < m->count; n++) {
    if (!m->alive[n]) continue;
    const nsvcd__triangle t = nsvcd__mending_triangle(m, n);
    const double area = nsvcd__triangle_area(&t);
    nsvcd__shell *part = &parts[forest[n]];
    part->area += area;
    part->centre = nsvcd__d3_fma(area, t.at[0], part->centre);
  }
}

// Counts odd and turned edges of the alive triangles, by their roots in a forest.
static void nsvcd__count_edges(const nsvcd__mending *m, const uint32_t *forest,
                               nsvcd__shell *parts) {
  for (size_t g = 0; g < m->group_count; g++) {
    size_t any = m->count;
    int sum = 0;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      if (!m->alive[m->order[i] / 3]) continue;
      any = m->order[i] / 3;
      sum += nsvcd__mending_edge(m, m->order[i]).rises ? 1 : -1;
    }
    if (any == m->count) continue;
    parts[forest[any]].odd += m->degrees[g] % 2;
    parts[forest[any]].turned += sum != 0;
  }
}

// Sets inner walls aside: triangles joined by edges of two, if at all their other edges, of three,
// they have the least area. Returns how many triangles. walls: (T) zeros, before and after.
static size_t nsvcd__drop_walls(nsvcd__mending *m, nsvcd__shell *walls) {
  size_t dropped = 0;
  nsvcd__join_triangles(m, 2, m->parts);
  nsvcd__sum_areas(m, m->parts, walls);
  for (size_t g = 0; g < m->group_count; g++) {
    size_t least = m->count;
    if (m->degrees[g] < 3) continue;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      const size_t n = m->order[i] / 3;
      if (!m->alive[n]) continue;
      const size_t wall = m->parts[n];
      walls[wall].odd++;
      if (least == m->count || walls[wall].area < walls[least].area) least = wall;
    }
    walls[least].turned += m->degrees[g] % 2;
  }
  for (size_t n = 0; n < m->count; n++) {
    const nsvcd__shell *wall = &walls[m->parts[n]];
    if (!m->alive[n] || wall->odd == 0 || wall->odd != wall->turned) continue;
    m->alive[n] = 0;
    dropped++;
  }
  memset(walls, 0, m->count * sizeof *walls);
  if (dropped > 0) nsvcd__count_degrees(m);
  return dropped;
}

// ---- holes

// A loop of border edges.
typedef struct nsvcd__hole {
  nsvcd__d3 centre, normal;
  double length, area, flush;
  size_t edges;
  uint32_t whole;
} nsvcd__hole;

// Three passes over the border edges: centres; the area and normal of a cone over each hole; and
// how far the triangles about a hole lie in its plane.
static void nsvcd__measure_holes(const nsvcd__mending *m, const uint32_t *numbers,
                                 nsvcd__hole *holes, int pass) {
  for (size_t e = 0; e < 3 * m->count; e++) {
    if (!nsvcd__is_border(m, e)) continue;
    const nsvcd__triangle t = nsvcd__mending_triangle(m, e / 3);
    nsvcd__hole *hole = &holes[numbers[nsvcd__mending_edge(m, e).ends[0]] - 1];
    const nsvcd__d3 from = t.at[e % 3];
    const nsvcd__d3 to = t.at[(e + 1) % 3];
    const double length = sqrt(nsvcd__d3_distance2(from, to));
    if (pass == 0) {
      hole->centre = nsvcd__d3_fma(0.5 * length, nsvcd__d3_add(from, to), hole->centre);
      hole->length += length;
      hole->edges++;
      hole->whole = m->wholes[e / 3];
      continue;
    }
    // a triangle that closed the hole would have the edge reversed
    const nsvcd__d3 centre = nsvcd__d3_scale(hole->centre, 1 / hole->length);
    const nsvcd__d3 a = nsvcd__d3_sub(to, centre);
    const nsvcd__d3 b = nsvcd__d3_sub(from, centre);
    const nsvcd__d3 n = nsvcd__d3_scale(nsvcd__d3_cross(a, b), 0.5);
    if (pass == 1) {
      hole->normal = nsvcd__d3_add(hole->normal, n);
      hole->area += nsvcd__d3_norm(n);
      continue;
    }
    const nsvcd__d3 along = nsvcd__area_vector(&t);
    const double size = nsvcd__d3_norm(along) * nsvcd__d3_norm(hole->normal);
    const double cosine = nsvcd__d3_dot(along, hole->normal);
    hole->flush += size > 0 ? length * cosine / size : 0;
  }
}

// What holes say of the wholes that they are in. A whole is a sheet if the surface does not go on
// across a hole, as at the rim of a bin, a tube or a floor. A slit, such as a corner on an edge
// makes, is no hole, and a missing triangle counts for a fraction of itself. With a larger hole
// only a surface that is wound outwards is nearly a solid: else it is a room with a door. 0 without
// memory.
static int nsvcd__judge_holes(const nsvcd__mending *m, nsvcd__shell *wholes,
                              const nsvcd_allocator *alloc) {
  const size_t vertices = m->topo->mesh->vertex_count;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  uint32_t *forest = NSVCD__TAKE(&arena, uint32_t, vertices);
  uint32_t *numbers = NSVCD__TAKE(&arena, uint32_t, vertices);
  uint32_t count = 0;
  for (uint32_t v = 0; forest && v < vertices; v++) forest[v] = v;
  for (size_t e = 0; !arena.failed && e < 3 * m->count; e++) {
    if (!nsvcd__is_border(m, e)) continue;
    const nsvcd__edge edge = nsvcd__mending_edge(m, e);
    nsvcd__join_roots(forest, edge.ends[0], edge.ends[1]);
    for (size_t k = 0; k < 2; k++) numbers[edge.ends[k]] = 1;
  }
  for (uint32_t v = 0; !arena.failed && v < vertices; v++) {
    if (!numbers[v]) continue;
    const uint32_t root = nsvcd__root(forest, v);
    numbers[v] = root == v ? ++count : numbers[root];
  }
  nsvcd__hole *holes = NSVCD__TAKE(&arena, nsvcd__hole, count);
  for (int pass = 0; !arena.failed && pass < 3; pass++)
    nsvcd__measure_holes(m, numbers, holes, pass);
  for (size_t h = 0; !arena.failed && h < count; h++) {
    const nsvcd__hole *hole = &holes[h];
    nsvcd__shell *whole = &wholes[hole->whole];
    const int is_slit = hole->area <= NSVCD__SLIT * hole->length * hole->length;
    const int is_flush = hole->flush >= NSVCD__FLUSH * hole->length;
    const int is_three = hole->edges == 3;
    whole->holes += (is_three ? NSVCD__HOLE_OF_THREE : 1) * hole->area;
    if (!is_slit && !is_flush) whole->is_sheet = 1;
    if (!is_slit && !is_three && !(whole->volume > 0)) whole->is_sheet = 1;
  }
  nsvcd__arena_free(&arena);
  return !arena.failed;
}

// ---- all of it

// Areas of wholes, and the volumes that they enclose, as seen from their centres.
static void nsvcd__measure_wholes(const nsvcd__mending *m, nsvcd__shell *wholes) {
  nsvcd__sum_areas(m, m->wholes, wholes);
  for (size_t n = 0; n < m->count; n++) {
    nsvcd__shell *whole = &wholes[m->wholes[n]];
    if (!m->alive[n] || !(whole->area > 0)) continue;
    const nsvcd__triangle t = nsvcd__mending_triangle(m, n);
    const nsvcd__d3 centre = nsvcd__d3_scale(whole->centre, 1 / whole->area);
    const nsvcd__d3 normal = nsvcd__area_vector(&t);
    whole->volume += nsvcd__d3_dot(normal, nsvcd__d3_sub(t.at[0], centre)) / 3;
  }
}

// Marks the triangles of the parts, left after peeling, that enclose something.
static void nsvcd__mark_parts(const nsvcd__mending *m, nsvcd__shell *wholes,
                              nsvcd__shell *parts, nsvcd__solids *out) {
  nsvcd__count_edges(m, m->parts, parts);
  nsvcd__sum_areas(m, m->parts, parts);
  for (size_t n = 0; n < m->count; n++) {
    if (!m->alive[n]) continue;
    const nsvcd__shell *part = &parts[m->parts[n]];
    nsvcd__shell *whole = &wholes[m->wholes[n]];
    const int is_most = part->area >= 0.5 * whole->area;
    const int kind = part->turned == 0           ? NSVCD__CLOSED
                     : part->odd == 0 && is_most ? NSVCD__EITHER_DIRECTION
                                                 : NSVCD__SHEET;
    out->kinds[m->triangles[n]] = (uint8_t)kind;
    if (kind == NSVCD__SHEET) {
      whole->fails = 1;
      continue;
    }
    if (m->parts[n] == n) whole->closed += part->area;
    for (size_t k = 0; k < 3; k++) {
      const float *at = m->topo->mesh->positions;
      const uint32_t v = m->topo->mesh->indices[3 * (size_t)m->triangles[n] + k];
      const uint32_t w = m->joined[m->topo->welded[v]];
      const double square = nsvcd__d3_distance2(nsvcd__d3_row(at, v), nsvcd__d3_row(at, w));
      out->gap = nsvcd__max(out->gap, sqrt(square));
    }
  }
}

// Counts the wholes, and marks what is nearly a solid. alive: as before peeling.
static void nsvcd__mark_wholes(const nsvcd__mending *m, nsvcd__shell *wholes,
                               nsvcd__solids *out) {
  for (size_t n = 0; n < m->count; n++) {
    if (!m->alive[n]) continue;
    const nsvcd__shell *whole = &wholes[m->wholes[n]];
    uint8_t *kind = &out->kinds[m->triangles[n]];
    const int is_closed = !whole->fails && whole->closed >= 0.5 * whole->area;
    const int is_nearly = !whole->is_sheet && whole->holes < NSVCD__HOLES * whole->area;
    if (m->wholes[n] == n) {
      out->components++;
      out->open_components += !is_closed;
      out->open_edges += is_closed ? 0 : whole->odd;
    }
    if (!is_closed && is_nearly && *kind == NSVCD__SHEET) *kind = NSVCD__NEARLY;
    out->is_mixed |= *kind == NSVCD__EITHER_DIRECTION || *kind == NSVCD__NEARLY;
  }
}

// Judges all triangles of `m`. 0 without memory.
static int nsvcd__mend(nsvcd__mending *m, nsvcd__arena *arena, nsvcd__solids *out) {
  const size_t count = m->count;
  uint8_t *distinct = NSVCD__TAKE(arena, uint8_t, count);
  nsvcd__shell *wholes = NSVCD__TAKE(arena, nsvcd__shell, count);
  nsvcd__shell *parts = NSVCD__TAKE(arena, nsvcd__shell, count);
  if (arena->failed || !nsvcd__mending_build(m, arena)) return 0;
  memcpy(distinct, m->alive, count);
  nsvcd__join_triangles(m, UINT32_MAX, m->wholes);
  nsvcd__measure_wholes(m, wholes);
  nsvcd__peel(m);
  for (int pass = 0; pass < 8 && nsvcd__drop_walls(m, parts) > 0; pass++) nsvcd__peel(m);
  nsvcd__join_triangles(m, UINT32_MAX, m->parts);
  nsvcd__mark_parts(m, wholes, parts, out);
  memcpy(m->alive, distinct, count);
  nsvcd__count_degrees(m);
  nsvcd__count_edges(m, m->wholes, wholes);
  if (!nsvcd__judge_holes(m, wholes, arena->allocator)) return 0;
  nsvcd__mark_wholes(m, wholes, out);
  return 1;
}

// Judges all triangles of a mesh. 0 without memory.
static int nsvcd__solids_build(const nsvcd__topology *topo, nsvcd__arena *arena,
                               nsvcd__solids *out) {
  const nsvcd_mesh *mesh = topo->mesh;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  nsvcd__mending m;
  memset(&m, 0, sizeof m);
  memset(out, 0, sizeof *out);
  m.topo = topo;
  out->kinds = NSVCD__TAKE(arena, uint8_t, mesh->triangle_count);
  m.triangles = NSVCD__TAKE(&spare, uint32_t, mesh->triangle_count);
  int ok = out->kinds && m.triangles;
  for (size_t v = 0; v < mesh->vertex_count; v++)
    out->components += topo->seen[v] && !topo->open[v];
  for (size_t t = 0; ok && t < mesh->triangle_count; t++) {
    uint32_t face[3];
    nsvcd__welded_face(topo, t, face);
    const int open = topo->open[topo->parents[face[0]]];
    out->kinds[t] = open ? NSVCD__SHEET : NSVCD__CLOSED;
    if (open && nsvcd__are_distinct(face)) m.triangles[m.count++] = (uint32_t)t;
  }
  if (ok && m.count > 0) ok = nsvcd__mend(&m, &spare, out);
  nsvcd__arena_free(&spare);
  return ok;
}
#endif  // NSVCD_NO_ENCODER
