// In: two bodies at one time. Out: what a ray from a corner of one crosses of the other; whether an
// edge passes through a triangle.
#pragma once
#include "planes.h"

#define NSVCD__UNCLEAR 2

// One body as another one sees it: in the other's frame, in units of its scale.
typedef struct nsvcd__seen {
  const nsvcd__moving *of, *by;
  nsvcd__dtransform of_at, by_at;
  // no length is more; no point is off by as much as the margin
  double lengths, margin;
} nsvcd__seen;

static nsvcd__seen nsvcd__seen_at(const nsvcd__moving *of, const nsvcd__moving *by, double t) {
  const nsvcd__node root = {0, 0, 1};
  nsvcd__seen s = {of, by, nsvcd__transform_at(of, t), nsvcd__transform_at(by, t), 0, 0};
  const double scale = by->model.scale;
  const double radii = nsvcd__node_radius(of, &root) + nsvcd__node_radius(by, &root);
  const double apart = nsvcd__d3_norm(nsvcd__d3_sub(s.of_at.position, s.by_at.position));
  const double positions =
      of->model.extent + by->model.extent + nsvcd__lengths_at(&s.of_at, &s.by_at);
  s.lengths = 1.000001 * (radii + apart) / scale;
  s.margin = NSVCD__CERTIFIED_MARGIN * (s.lengths + positions / scale);
  return s;
}

static nsvcd__d3 nsvcd__seen_vertex(const nsvcd__seen *s, uint32_t vertex) {
  const nsvcd__d3 x = nsvcd__d3_row(s->of->tree->mesh.positions, vertex);
  const nsvcd__d3 offset = nsvcd__d3_sub(s->of_at.position, s->by_at.position);
  const nsvcd__d3 world = nsvcd__d3_add(nsvcd__turned_by(s->of, &s->of_at, x), offset);
  return nsvcd__d3_scale(nsvcd__dmat3_apply_transpose(&s->by_at.rotation, world),
                         1 / s->by->model.scale);
}

// The corners of a triangle.
static void nsvcd__seen_triangle(const nsvcd__seen *s, uint32_t triangle, nsvcd__d3 *out) {
  const uint32_t *corners = s->of->tree->mesh.indices + 3 * (size_t)triangle;
  for (size_t k = 0; k < 3; k++) out[k] = nsvcd__seen_vertex(s, corners[k]);
}

// A ray in the frame of the other body: does it leave (1) or enter (-1) through a triangle of that,
// or miss it (0)? UNCLEAR: by too little.
static int nsvcd__ray_passes(const nsvcd__seen *s, uint32_t triangle, nsvcd__d3 from,
                             nsvcd__d3 along) {
  const double length = nsvcd__d3_norm(along);
  const double rounding = 1e-4 * NSVCD__CERTIFIED_MARGIN * s->lengths * s->lengths;
  nsvcd__d3 p[3], crosses[3];
  int left = 0;
  int right = 0;
  for (uint32_t k = 0; k < 3; k++) {
    const float *corner = nsvcd__tree_corner(s->by->tree, triangle, k);
    p[k] = nsvcd__d3_sub(nsvcd__d3_load(corner), from);
  }
  const double ahead =
      nsvcd__max(nsvcd__d3_dot(p[0], along),
                 nsvcd__max(nsvcd__d3_dot(p[1], along), nsvcd__d3_dot(p[2], along)));
  if (ahead < -1.01 * s->margin * length) return 0;
  for (size_t k = 0; k < 3; k++) {
    crosses[k] = nsvcd__d3_cross(p[k], p[(k + 1) % 3]);
    const double edge = sqrt(nsvcd__d3_distance2(p[k], p[(k + 1) % 3]));
    const double off =
        length * (s->margin * edge + rounding) + 2 * s->margin * nsvcd__d3_norm(crosses[k]);
    left += nsvcd__d3_dot(along, crosses[k]) > off;
    right += nsvcd__d3_dot(along, crosses[k]) < -off;
  }
  if (left > 0 && right > 0) return 0;
  if (left < 3 && right < 3) return NSVCD__UNCLEAR;
  const nsvcd__d3 sum = nsvcd__d3_add(crosses[1], crosses[2]);
  const nsvcd__d3 normal = nsvcd__d3_add(crosses[0], sum);
  const double volume = nsvcd__d3_dot(p[2], crosses[0]);
  const double off = s->margin * nsvcd__d3_norm(normal) + rounding * s->lengths;
  if (!(fabs(volume) > off)) return NSVCD__UNCLEAR;
  if ((volume > 0) != (left > 0)) return 0;
  return left > 0 ? 1 : -1;
}

// Does a ray miss a box for certain? Then some axis, across the ray and across a side of the box,
// separates them.
static int nsvcd__ray_misses(const nsvcd__box *box, nsvcd__d3 from, nsvcd__d3 along,
                             double margin) {
  const nsvcd__d3 low = nsvcd__d3_sub(nsvcd__d3_widen(box->low), from);
  const nsvcd__d3 high = nsvcd__d3_sub(nsvcd__d3_widen(box->high), from);
  const nsvcd__d3 middle = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5);
  const nsvcd__d3 half = nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5);
  const nsvcd__d3 size = nsvcd__d3_of(fabs(along.x), fabs(along.y), fabs(along.z));
  const nsvcd__d3 off = nsvcd__d3_cross(along, middle);
  return fabs(off.x) > size.y * half.z + size.z * half.y + margin ||
         fabs(off.y) > size.z * half.x + size.x * half.z + margin ||
         fabs(off.z) > size.x * half.y + size.y * half.x + margin;
}

// Casts a ray. *winding: how often the closed components of the other body wind about where it
// begins. sums: (vertices), scratch: what it crosses, by component. Returns 0 where that is not
// clear.
static int nsvcd__cast(const nsvcd__seen *s, nsvcd__d3 from, nsvcd__d3 along, int32_t *sums,
                       int *winding) {
  const nsvcd_tree *tree = s->by->tree;
  const double margin = s->margin * nsvcd__d3_norm(along);
  nsvcd__node stack[NSVCD__TREE_STACK] = {{0, 0, (uint32_t)tree->mesh.triangle_count}};
  size_t height = 1;
  memset(sums, 0, tree->mesh.vertex_count * sizeof *sums);
  while (height > 0) {
    const nsvcd__node node = stack[--height];
    if (nsvcd__ray_misses(&tree->boxes[node.box], from, along, margin)) continue;
    if (node.count > 1) {
      nsvcd__children(&node, &stack[height], &stack[height + 1]);
      height += 2;
      continue;
    }
    const uint32_t triangle = tree->order[node.first];
    const int crossed = nsvcd__ray_passes(s, triangle, from, along);
    if (crossed == NSVCD__UNCLEAR) return 0;
    sums[tree->component[tree->mesh.indices[3 * (size_t)triangle]]] += crossed;
  }
  *winding = 0;
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) *winding += tree->open[v] ? 0 : sums[v];
  return 1;
}
