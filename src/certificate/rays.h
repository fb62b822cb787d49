// In: two bodies at one time. Out: what a ray from a corner of one crosses of the other; whether an
// edge passes through a triangle.
#pragma once
#include "planes.h"

#ifndef NSVCD_NO_CERTIFICATES
#define NSVCD__UNCLEAR 2

// A vertex of one body in the frame of another, in units of that one's scale.
static nsvcd__d3 nsvcd__vertex_seen(const nsvcd__rider *of, const nsvcd__posed *of_at,
                                    const nsvcd__rider *by, const nsvcd__posed *by_at,
                                    uint32_t vertex) {
  const nsvcd__d3 x = nsvcd__d3_row(of->tree->mesh.positions, vertex);
  const nsvcd__d3 offset = nsvcd__d3_sub(of_at->at, by_at->at);
  const nsvcd__d3 world = nsvcd__d3_add(nsvcd__turned_by(of, of_at, x), offset);
  return nsvcd__d3_scale(nsvcd__dmat3_apply_transpose(&by_at->turn, world), 1 / by->scale);
}

// No length in that frame is more.
static double nsvcd__lengths_seen(const nsvcd__rider *of, const nsvcd__posed *of_at,
                                  const nsvcd__rider *by, const nsvcd__posed *by_at) {
  const nsvcd__node root = {0, 0, 2};
  const double radii = nsvcd__node_radius(of, &root) + nsvcd__node_radius(by, &root);
  return (radii + nsvcd__lengths_at(of_at, by_at)) / by->scale;
}

// Does a ray leave (1) or enter (-1) through a triangle, or miss it (0)? UNCLEAR: by too little.
static int nsvcd__ray_passes(const nsvcd_tree *tree, uint32_t triangle, nsvcd__d3 from,
                             nsvcd__d3 along, double lengths) {
  const double margin = NSVCD__CERTIFIED_MARGIN * lengths * lengths;
  const double area = margin * nsvcd__d3_length(along);
  nsvcd__d3 p[3];
  double sides[3];
  for (uint32_t k = 0; k < 3; k++)
    p[k] = nsvcd__d3_sub(nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, k)), from);
  const double ahead =
      nsvcd__max(nsvcd__d3_dot(p[0], along),
                 nsvcd__max(nsvcd__d3_dot(p[1], along), nsvcd__d3_dot(p[2], along)));
  if (ahead * lengths < -area) return 0;
  for (size_t k = 0; k < 3; k++)
    sides[k] = nsvcd__d3_dot(along, nsvcd__d3_cross(p[k], p[(k + 1) % 3]));
  const double least = nsvcd__min(sides[0], nsvcd__min(sides[1], sides[2]));
  const double most = nsvcd__max(sides[0], nsvcd__max(sides[1], sides[2]));
  if (least < -area && most > area) return 0;
  if (!(least > area || most < -area)) return NSVCD__UNCLEAR;
  const double volume = nsvcd__d3_dot(p[2], nsvcd__d3_cross(p[0], p[1]));
  if (!(fabs(volume) > margin * lengths)) return NSVCD__UNCLEAR;
  if ((volume > 0) != (most > 0)) return 0;
  return most > 0 ? 1 : -1;
}

// Sums what a ray crosses, by parts of the tree: sums (vertices). Returns 0 where it is not clear.
static int nsvcd__cast(const nsvcd_tree *tree, nsvcd__d3 from, nsvcd__d3 along, double lengths,
                       int32_t *sums) {
  memset(sums, 0, tree->mesh.vertex_count * sizeof *sums);
  for (size_t t = 0; t < tree->mesh.triangle_count; t++) {
    const int crossed = nsvcd__ray_passes(tree, (uint32_t)t, from, along, lengths);
    if (crossed == NSVCD__UNCLEAR) return 0;
    sums[tree->part[tree->mesh.indices[3 * t]]] += crossed;
  }
  return 1;
}

// How often there is an edge from one vertex to another.
static long nsvcd__edges_between(const nsvcd_tree *tree, uint32_t from, uint32_t to) {
  const nsvcd__f3 x = nsvcd__f3_load(tree->mesh.positions + 3 * (size_t)from);
  nsvcd__node stack[NSVCD__TREE_STACK] = {{0, 0, (uint32_t)tree->mesh.triangle_count}};
  size_t height = 1;
  long count = 0;
  while (height > 0) {
    const nsvcd__node node = stack[--height];
    const nsvcd__box *box = &tree->boxes[node.box];
    if (nsvcd__f3_exceeds(x, box->high) || nsvcd__f3_exceeds(box->low, x)) continue;
    if (node.count > 1) {
      nsvcd__children(&node, &stack[height], &stack[height + 1]);
      height += 2;
      continue;
    }
    const uint32_t *corner = tree->mesh.indices + 3 * (size_t)tree->order[node.first];
    for (size_t k = 0; k < 3; k++) count += corner[k] == from && corner[(k + 1) % 3] == to;
  }
  return count;
}

// Of what a ray crosses, what closed parts have: those of which each edge has as many reverses.
static int nsvcd__sum_of_closed(const nsvcd_tree *tree, int32_t *sums) {
  const uint32_t *indices = tree->mesh.indices;
  int sum = 0;
  for (size_t i = 0; i < 3 * tree->mesh.triangle_count; i++) {
    const uint32_t from = indices[i];
    const uint32_t to = indices[i % 3 == 2 ? i - 2 : i + 1];
    int32_t *crossed = &sums[tree->part[from]];
    if (*crossed == 0) continue;
    if (nsvcd__edges_between(tree, from, to) != nsvcd__edges_between(tree, to, from))
      *crossed = 0;
  }
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) sum += sums[v];
  return sum;
}
#endif  // NSVCD_NO_CERTIFICATES
