// mesh_check.h - what a person would want to know of a mesh before it is encoded: how large it is,
// whether it is closed, whether neighbours agree which side is out, and whether that is out.
//
//   mesh_report report;
//   char lines[MESH_FINDINGS][MESH_LINE];
//   int grave;
//   if (mesh_check(&mesh, 0.001, &report))  // in millimetres
//     for (int i = 0, count = mesh_findings(&report, lines, &grave); i < count; i++)
//       puts(lines[i]);
//
// Vertices at the same place are one, and a component is closed if each of its edges has its
// reverse. Include neuralsvcd.h first.
#ifndef NSVCD_SCENERY_MESH_CHECK_H
#define NSVCD_SCENERY_MESH_CHECK_H

#include <stdio.h>

#include "oracle.h"

#define MESH_DEF ORACLE_DEF
#define MESH_LARGE 30.0     // metres
#define MESH_LARGE_STL 3.0  // metres, for STL: its files are mostly in millimetres

typedef struct mesh_report {
  double scale;        // metres in one of the mesh's units
  double large;        // metres: a body beyond this is hardly meant
  const char *advice;  // NULL, or a --scale to be advised in place of this one mesh's own
  size_t triangles, vertices;
  double low[3], high[3];  // metres: a box of the vertices that triangles use
  double area;             // square metres
  double volume;           // cubic metres, of the closed components; negative: inside out
  size_t components, closed;
  size_t inwards;        // closed components of negative volume: cavities, or inside out
  size_t open_edges;     // edges of one triangle
  size_t crowded_edges;  // edges of more than two
  size_t turned_edges;   // edges of two triangles that do not agree which side is out
  size_t flat;           // triangles without area
} mesh_report;

// -------------------------------------------------------------------------------------- components

typedef struct mesh_component {
  double volume;
  int seen, open;
} mesh_component;

typedef struct mesh_edge {
  uint64_t ends;  // the lesser one first
  uint32_t root;  // the component's
  int along;      // 1: from the lesser end to the greater, -1: back
} mesh_edge;

typedef struct mesh_parts {
  double *positions;           // (vertices, 3) metres
  uint32_t *welded, *parents;  // (vertices)
  mesh_component *components;  // (vertices) at the root of each
  mesh_edge *edges;            // (3 triangles)
  size_t edge_count;
} mesh_parts;

MESH_DEF void mesh_parts_free(mesh_parts *parts) {
  free(parts->positions);
  free(parts->welded);
  free(parts->parents);
  free(parts->components);
  free(parts->edges);
}

// 0 without memory. Release with mesh_parts_free either way.
MESH_DEF int mesh_parts_init(mesh_parts *parts, const nsvcd_mesh *mesh, double scale) {
  const size_t n = mesh->vertex_count + 1;
  memset(parts, 0, sizeof *parts);
  parts->positions = (double *)malloc(3 * n * sizeof *parts->positions);
  parts->welded = (uint32_t *)malloc(n * sizeof *parts->welded);
  parts->parents = (uint32_t *)malloc(n * sizeof *parts->parents);
  parts->components = (mesh_component *)calloc(n, sizeof *parts->components);
  parts->edges = (mesh_edge *)malloc((3 * mesh->triangle_count + 1) * sizeof *parts->edges);
  if (!parts->positions || !parts->welded || !parts->parents || !parts->components || !parts->edges)
    return 0;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    parts->positions[i] = scale * (double)mesh->positions[i];
  if (!oracle_weld(parts->positions, mesh->vertex_count, parts->welded)) return 0;
  for (size_t i = 0; i < mesh->vertex_count; i++) parts->parents[i] = (uint32_t)i;
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    const uint32_t a = oracle_find(parts->parents, parts->welded[mesh->indices[i]]);
    const uint32_t b = oracle_find(parts->parents, parts->welded[mesh->indices[i - i % 3]]);
    parts->parents[a] = b;
  }
  return 1;
}

// -------------------------------------------------------------------------------- triangles, edges

// The welded corners of triangle t, and its component.
MESH_DEF mesh_component *mesh_corners(mesh_parts *parts, const nsvcd_mesh *mesh, size_t t,
                                      uint32_t *corners) {
  for (size_t k = 0; k < 3; k++) corners[k] = parts->welded[mesh->indices[3 * t + k]];
  return &parts->components[oracle_find(parts->parents, corners[0])];
}

MESH_DEF void mesh_bounds(const nsvcd_mesh *mesh, const double *positions, mesh_report *report) {
  for (size_t k = 0; k < 3; k++) {
    report->low[k] = HUGE_VAL;
    report->high[k] = -HUGE_VAL;
  }
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
    for (size_t k = 0; k < 3; k++) {
      const double x = positions[3 * (size_t)mesh->indices[i] + k];
      report->low[k] = fmin(report->low[k], x);
      report->high[k] = fmax(report->high[k], x);
    }
}

// Area and volume; the latter as seen from the middle of the box.
MESH_DEF void mesh_measure(const nsvcd_mesh *mesh, mesh_parts *parts, mesh_report *report) {
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    uint32_t corners[3];
    double v[3][3], ab[3], ac[3], bc[3], normal[3];
    mesh_component *component = mesh_corners(parts, mesh, t, corners);
    for (size_t i = 0; i < 3; i++)
      for (size_t k = 0; k < 3; k++)
        v[i][k] =
            parts->positions[3 * (size_t)corners[i] + k] - (report->low[k] + report->high[k]) / 2;
    oracle_sub(v[1], v[0], ab);
    oracle_sub(v[2], v[0], ac);
    oracle_sub(v[2], v[1], bc);
    oracle_cross(ab, ac, normal);
    const double twice = oracle_length(normal);
    const double longest = fmax(oracle_dot(ab, ab), fmax(oracle_dot(ac, ac), oracle_dot(bc, bc)));
    report->area += twice / 2;
    // so thin that it is less than a rounding of its corners
    report->flat += twice <= 1e-7 * longest;
    report->components += !component->seen;
    component->seen = 1;
    component->volume += oracle_dot(normal, v[0]) / 6;
  }
}

MESH_DEF int mesh_edge_compare(const void *pa, const void *pb) {
  const uint64_t a = ((const mesh_edge *)pa)->ends;
  const uint64_t b = ((const mesh_edge *)pb)->ends;
  return (a > b) - (a < b);
}

// Lists all edges, but those of triangles with two corners at one place: they cancel among
// themselves.
MESH_DEF void mesh_list_edges(const nsvcd_mesh *mesh, mesh_parts *parts) {
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    uint32_t corners[3];
    const mesh_component *component = mesh_corners(parts, mesh, t, corners);
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (size_t k = 0; k < 3; k++) {
      const uint64_t from = corners[k];
      const uint64_t to = corners[(k + 1) % 3];
      mesh_edge *edge = &parts->edges[parts->edge_count++];
      edge->ends = from < to ? from << 32 | to : to << 32 | from;
      edge->root = (uint32_t)(component - parts->components);
      edge->along = from < to ? 1 : -1;
    }
  }
  qsort(parts->edges, parts->edge_count, sizeof *parts->edges, mesh_edge_compare);
}

MESH_DEF void mesh_judge_edges(mesh_parts *parts, mesh_report *report) {
  const mesh_edge *edges = parts->edges;
  size_t end;
  for (size_t first = 0; first < parts->edge_count; first = end) {
    int sum = 0;
    for (end = first; end < parts->edge_count && edges[end].ends == edges[first].ends; end++)
      sum += edges[end].along;
    report->open_edges += end - first == 1;
    report->crowded_edges += end - first > 2;
    report->turned_edges += end - first == 2 && sum != 0;
    if (sum != 0) parts->components[edges[first].root].open = 1;
  }
}

// ------------------------------------------------------------------------------------------ report

// mesh: checked, as nsvcd_obj_load leaves it. Returns 0 without memory.
MESH_DEF int mesh_check(const nsvcd_mesh *mesh, double scale, mesh_report *report) {
  mesh_parts parts;
  const int good = mesh_parts_init(&parts, mesh, scale);
  memset(report, 0, sizeof *report);
  report->scale = scale;
  report->large = MESH_LARGE;
  report->triangles = mesh->triangle_count;
  report->vertices = mesh->vertex_count;
  if (good) {
    mesh_bounds(mesh, parts.positions, report);
    mesh_measure(mesh, &parts, report);
    mesh_list_edges(mesh, &parts);
    mesh_judge_edges(&parts, report);
  }
  for (size_t i = 0; good && i < mesh->vertex_count; i++) {
    const mesh_component *component = &parts.components[i];
    if (!component->seen || component->open) continue;
    report->closed++;
    report->volume += component->volume;
    report->inwards += component->volume < 0;
  }
  mesh_parts_free(&parts);
  return good;
}

MESH_DEF double mesh_extent(const mesh_report *report) {
  double most = 0;
  for (int k = 0; k < 3; k++) most = fmax(most, report->high[k] - report->low[k]);
  return most;
}

// ---------------------------------------------------------------------------------------- findings

#define MESH_FINDINGS 8
#define MESH_LINE 200  // characters
// metres: bodies beyond these are hardly meant
#define MESH_SMALL 0.001

// The scale by which the mesh is of a likely size: its own, if it is.
MESH_DEF double mesh_likely_scale(const mesh_report *report) {
  const double extent = mesh_extent(report);
  return report->scale * (extent > report->large ? 0.001 : extent < MESH_SMALL ? 1000 : 1);
}
MESH_DEF int mesh_find_size(const mesh_report *report, char *line) {
  const double extent = mesh_extent(report);
  const double likely = mesh_likely_scale(report);
  char own[32];
  snprintf(own, sizeof own, "%g", likely);
  if (likely != report->scale)
    snprintf(line, MESH_LINE, "a body of %.4g m: %s? try --scale %s", extent,
             likely < report->scale ? "are these millimetres" : "is it too small by a thousand",
             report->advice ? report->advice : own);
  return likely != report->scale;
}
// Is the mesh so far from its origin that floats are a millimetre apart or more there?
MESH_DEF int mesh_find_far(const mesh_report *report, char *line) {
  double far_off = 0;
  for (int k = 0; k < 3; k++) far_off = fmax(far_off, fmax(report->high[k], -report->low[k]));
  const double apart = far_off / 8388608;
  if (apart < 0.001 || far_off < 4 * mesh_extent(report)) return 0;
  snprintf(line, MESH_LINE,
           "%.4g m from its origin, where floats are %.2g m apart: of a map? try --recentre",
           far_off, apart);
  return 1;
}
MESH_DEF int mesh_find_volume(const mesh_report *report, char *line) {
  const double least = 1e-9 * pow(report->area, 1.5);  // a ball's is 0.09 of that
  if (!report->closed || report->volume > least) return 0;
  if (report->volume < -least)
    snprintf(line, MESH_LINE, "inside out: its volume is %.4g m3; turn its faces round",
             report->volume);
  else
    snprintf(line, MESH_LINE, "flat: it is closed, and encloses nothing");
  return 1;
}
MESH_DEF int mesh_find_count(size_t count, const char *one, const char *many, const char *meaning,
                             char *line) {
  if (count) snprintf(line, MESH_LINE, "%zu %s: %s", count, count == 1 ? one : many, meaning);
  return count > 0;
}

// Are there triangles much larger than the patches of the body that was made of it? These follow
// the area, and so leave few to the small ones.
MESH_DEF int mesh_find_large(const nsvcd_mesh *mesh, const nsvcd_body_facts *facts, char *line) {
  const double limit = 16 * (double)facts->mean_patch_radius;
  size_t large = 0;
  if (facts->triangles < 16 * facts->patches) return 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    double longest = 0;
    for (size_t i = 0; i < 3; i++) {
      const float *from = mesh->positions + 3 * (size_t)mesh->indices[3 * t + i];
      const float *to = mesh->positions + 3 * (size_t)mesh->indices[3 * t + (i + 1) % 3];
      double d[3];
      for (int k = 0; k < 3; k++) d[k] = (double)to[k] - (double)from[k];
      longest = fmax(longest, oracle_length(d));
    }
    large += longest > limit;
  }
  return mesh_find_count(large, "triangle is too large for the patches",
                         "triangles are too large for the patches",
                         "these follow the area, and small triangles crowd in few of them; try "
                         "more --points",
                         line);
}
// Is the surface of the body that was made of it closed, but for what the library mends, or is it
// said to be open?
MESH_DEF int mesh_find_open(const nsvcd_body_facts *facts, char *line) {
  if (facts->open || facts->open_components == 0) return 0;
  snprintf(line, MESH_LINE,
           "not a closed surface: %zu open edge%s in %zu of %zu component%s; what is inside of it "
           "is not known to be inside (say --open if it is a sheet)",
           facts->open_edges, facts->open_edges == 1 ? "" : "s", facts->open_components,
           facts->components, facts->components == 1 ? "" : "s");
  return 1;
}
// Writes what is wrong with a mesh, a line each, without its name. Returns how many. *grave: how
// many of them, the first ones, can change an answer. Two more are found of the body.
MESH_DEF int mesh_findings(const mesh_report *report, char lines[MESH_FINDINGS][MESH_LINE],
                           int *grave) {
  int count = mesh_find_size(report, lines[0]);
  count += mesh_find_far(report, lines[count]);
  count += mesh_find_volume(report, lines[count]);
  count += mesh_find_count(report->turned_edges, "edge of inconsistent winding",
                           "edges of inconsistent winding",
                           "neighbours do not agree which side is out", lines[count]);
  *grave = count;
  count += mesh_find_count(report->crowded_edges, "non-manifold edge", "non-manifold edges",
                           "more than two triangles meet there", lines[count]);
  count += mesh_find_count(report->flat, "degenerate triangle", "degenerate triangles",
                           "no area, as of faces with corners in a line: harmless", lines[count]);
  return count;
}

#endif
