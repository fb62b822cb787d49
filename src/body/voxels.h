// In: a mesh. Out: a grid of cells: which of them the surface passes through, which are outside it,
// and how far each of the others is from there.
//
// Lines through the centres, along each axis, mark the cells in which they cross a triangle. So no
// path from centre to centre of neighbouring cells leads through the surface unmarked, and what
// such paths reach from the rim of the grid is outside; but not where the six rays from a centre,
// up and down these lines, say that the surface winds about it. These votes close the holes that
// meshes of robots have.
#pragma once
#include "../mesh/mesh.h"
#include "../ground/memory.h"

#ifndef NSVCD_NO_ENCODER
// cells along the longest axis of the mesh's box; cells of the rim; votes for what is inside
#define NSVCD__VOXELS 96
#define NSVCD__VOXEL_RIM 2
#define NSVCD__VOXEL_VOTES 4

enum { NSVCD__VOXEL_HOLLOW, NSVCD__VOXEL_SURFACE, NSVCD__VOXEL_OUTSIDE };

typedef struct nsvcd__voxels {
  // of the first cell's centre
  nsvcd__d3 first;
  // metres
  double edge;
  // cells along each axis, and of the whole grid
  size_t sizes[3], count;
  // (count), x fastest: HOLLOW: neither outside nor surface
  uint8_t *kinds;
  // (count): the sum of six winding numbers, by the rays along the axes
  int8_t *votes;
  // (count): by how much the winding number changes, up along an axis, before the centre
  int8_t *turns;
  // (count): in cells, from centre to centre of the nearest cell outside
  float *depths;
} nsvcd__voxels;

static size_t nsvcd__voxel_stride(const nsvcd__voxels *v, size_t axis) {
  return axis == 0 ? 1 : axis == 1 ? v->sizes[0] : v->sizes[0] * v->sizes[1];
}

// Where a cell is, in cells.
static nsvcd__f3 nsvcd__cell_place(const nsvcd__voxels *v, size_t cell) {
  const size_t rows = cell / v->sizes[0];
  return nsvcd__f3_of((float)(cell % v->sizes[0]), (float)(rows % v->sizes[1]),
                      (float)(rows / v->sizes[1]));
}
static nsvcd__d3 nsvcd__voxel_centre(const nsvcd__voxels *v, size_t cell) {
  return nsvcd__d3_fma(v->edge, nsvcd__d3_widen(nsvcd__cell_place(v, cell)), v->first);
}

// The cell that a point of the mesh is in.
static size_t nsvcd__voxel_at(const nsvcd__voxels *v, nsvcd__d3 point) {
  const nsvcd__d3 at = nsvcd__d3_scale(nsvcd__d3_sub(point, v->first), 1 / v->edge);
  size_t cell = 0;
  for (size_t k = 0; k < 3; k++) {
    const size_t i = (size_t)(nsvcd__d3_axis(at, k) + 0.5);
    cell += (i < v->sizes[k] ? i : v->sizes[k] - 1) * nsvcd__voxel_stride(v, k);
  }
  return cell;
}

static void nsvcd__mesh_triangle(const nsvcd_mesh *mesh, size_t t, nsvcd__d3 *corners) {
  for (size_t k = 0; k < 3; k++)
    corners[k] = nsvcd__d3_row(mesh->positions, mesh->indices[3 * t + k]);
}

// Marks the cells along an edge.
static void nsvcd__mark_edge(nsvcd__voxels *v, nsvcd__d3 a, nsvcd__d3 b) {
  const size_t steps = 1 + (size_t)(2 * sqrt(nsvcd__d3_distance2(a, b)) / v->edge);
  for (size_t n = 0; n <= steps; n++) {
    const nsvcd__d3 point = nsvcd__d3_mix(a, b, (double)n / (double)steps);
    v->kinds[nsvcd__voxel_at(v, point)] = NSVCD__VOXEL_SURFACE;
  }
}

// Twice the area of a triangle of the plane, with its sign.
static double nsvcd__area_of(const double *a, const double *b, const double *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Marks the cells in which lines along an axis cross a triangle, and where the winding number
// changes: at the first centre above.
static void nsvcd__mark_crossings(nsvcd__voxels *v, const nsvcd__d3 *corners, size_t axis) {
  const size_t across[2] = {(axis + 1) % 3, (axis + 2) % 3};
  const size_t stride = nsvcd__voxel_stride(v, axis);
  double p[3][2], heights[3], low[2], high[2];
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 at = nsvcd__d3_scale(nsvcd__d3_sub(corners[k], v->first), 1 / v->edge);
    heights[k] = nsvcd__d3_axis(at, axis);
    for (size_t i = 0; i < 2; i++) {
      p[k][i] = nsvcd__d3_axis(at, across[i]);
      low[i] = k ? nsvcd__min(low[i], p[k][i]) : p[k][i];
      high[i] = k ? nsvcd__max(high[i], p[k][i]) : p[k][i];
    }
  }
  const double whole = nsvcd__area_of(p[0], p[1], p[2]);
  if (!(fabs(whole) > 0)) return;
  // Half open, by the order of the corners, so that of two triangles at an edge one is crossed; and
  // closed, for what is marked.
  double at[2];
  for (at[0] = ceil(low[0]); at[0] <= high[0]; at[0]++) {
    for (at[1] = ceil(low[1]); at[1] <= high[1]; at[1]++) {
      double height = 0;
      int is_in = 1;
      int counts = 1;
      for (size_t k = 0; k < 3; k++) {
        const double *a = p[(k + 1) % 3];
        const double *b = p[(k + 2) % 3];
        const double part = nsvcd__area_of(at, a, b) * (whole < 0 ? -1 : 1);
        const int is_left = (a[1] - b[1]) * (whole < 0 ? -1 : 1) > 0 ||
                            (!(a[1] > b[1]) && !(a[1] < b[1]) && (a[0] < b[0]) == (whole < 0));
        is_in &= part >= -1e-9 * fabs(whole);
        counts &= part > 0 || (part >= 0 && is_left);
        height += heights[k] * part / fabs(whole);
      }
      if (!is_in) continue;
      const size_t column = (size_t)at[0] * nsvcd__voxel_stride(v, across[0]) +
                            (size_t)at[1] * nsvcd__voxel_stride(v, across[1]);
      const double clamped = nsvcd__max(0, nsvcd__min(height, (double)v->sizes[axis] - 1));
      v->kinds[column + (size_t)(clamped + 0.5) * stride] = NSVCD__VOXEL_SURFACE;
      int8_t *turns = &v->turns[column + (size_t)ceil(clamped) * stride];
      if (counts) *turns = (int8_t)(*turns + (whole > 0 ? -1 : 1));
    }
  }
}

// Adds the votes of the rays along an axis, from below and from above.
static void nsvcd__count_votes(nsvcd__voxels *v, size_t axis) {
  const size_t stride = nsvcd__voxel_stride(v, axis);
  for (size_t n = 0; n < v->count; n++) {
    if (n / stride % v->sizes[axis] > 0) continue;
    int all = 0;
    int below = 0;
    for (size_t k = 0; k < v->sizes[axis]; k++) all += v->turns[n + k * stride];
    for (size_t k = 0; k < v->sizes[axis]; k++) {
      int8_t *votes = &v->votes[n + k * stride];
      below += v->turns[n + k * stride];
      *votes = (int8_t)(*votes + 2 * below - all);
    }
  }
}

static int nsvcd__is_voted_inside(const nsvcd__voxels *v, size_t cell) {
  return v->votes[cell] >= NSVCD__VOXEL_VOTES || v->votes[cell] <= -NSVCD__VOXEL_VOTES;
}

// What the rim reaches without crossing the surface is outside, but for what is voted inside.
// queue: (count).
static void nsvcd__fill_outside(nsvcd__voxels *v, uint32_t *queue) {
  size_t left = 1;
  queue[0] = 0;
  v->kinds[0] = NSVCD__VOXEL_OUTSIDE;
  while (left > 0) {
    const size_t cell = queue[--left];
    for (size_t axis = 0; axis < 3; axis++) {
      const size_t stride = nsvcd__voxel_stride(v, axis);
      const size_t at = cell / stride % v->sizes[axis];
      const size_t next[2] = {at > 0 ? cell - stride : cell,
                              at + 1 < v->sizes[axis] ? cell + stride : cell};
      for (size_t side = 0; side < 2; side++) {
        if (v->kinds[next[side]] != NSVCD__VOXEL_HOLLOW) continue;
        v->kinds[next[side]] = NSVCD__VOXEL_OUTSIDE;
        queue[left++] = (uint32_t)next[side];
      }
    }
  }
  for (size_t n = 0; n < v->count; n++) {
    if (v->kinds[n] == NSVCD__VOXEL_OUTSIDE && nsvcd__is_voted_inside(v, n))
      v->kinds[n] = NSVCD__VOXEL_HOLLOW;
  }
}

// One row of a distance transform: of squared distances, the least of x[m] + (n - m)^2 over all m,
// the lower envelope of parabolas. Source: Felzenszwalb and Huttenlocher (2012).
static void nsvcd__transform_row(float *x, size_t stride, size_t count) {
  double value[NSVCD__VOXELS + 2 * NSVCD__VOXEL_RIM + 1];
  double from[NSVCD__VOXELS + 2 * NSVCD__VOXEL_RIM + 1];
  size_t lowest[NSVCD__VOXELS + 2 * NSVCD__VOXEL_RIM + 1];
  size_t last = 0;
  for (size_t n = 0; n < count; n++) value[n] = (double)x[n * stride];
  lowest[0] = 0;
  from[0] = -HUGE_VAL;
  for (size_t n = 1; n < count; n++) {
    double meet;
    for (;;) {
      const size_t m = lowest[last];
      const double rise = value[n] + (double)(n * n) - value[m] - (double)(m * m);
      meet = rise / (2 * (double)(n - m));
      if (meet > from[last]) break;
      last--;
    }
    lowest[++last] = n;
    from[last] = meet;
  }
  for (size_t n = count; n-- > 0;) {
    while (from[last] > (double)n) last--;
    const double offset = (double)n - (double)lowest[last];
    x[n * stride] = (float)(value[lowest[last]] + offset * offset);
  }
}

static void nsvcd__measure_depths(nsvcd__voxels *v) {
  for (size_t n = 0; n < v->count; n++)
    v->depths[n] = v->kinds[n] == NSVCD__VOXEL_OUTSIDE ? 0 : 1e6f;
  for (size_t axis = 0; axis < 3; axis++) {
    const size_t stride = nsvcd__voxel_stride(v, axis);
    for (size_t n = 0; n < v->count; n++) {
      if (n / stride % v->sizes[axis] == 0)
        nsvcd__transform_row(v->depths + n, stride, v->sizes[axis]);
    }
  }
  for (size_t n = 0; n < v->count; n++) v->depths[n] = sqrtf(v->depths[n]);
}

// 0 without memory. The mesh is checked, and not a cloud. is_open: nothing is inside it.
static int nsvcd__voxels_build(const nsvcd_mesh *mesh, int is_open, nsvcd__arena *arena,
                               nsvcd__voxels *v) {
  nsvcd__d3 low, high;
  nsvcd__mesh_box(mesh, &low, &high);
  const nsvcd__d3 size = nsvcd__d3_sub(high, low);
  const double longest = nsvcd__d3_axis(size, nsvcd__d3_longest(size));
  const nsvcd__d3 ones = {1, 1, 1};
  // of a point it is as short as can be told where it is
  v->edge = nsvcd__max(longest / NSVCD__VOXELS, 1e-9 * (1e-6 + nsvcd__d3_norm(low)));
  v->first = nsvcd__d3_fma((0.5 - NSVCD__VOXEL_RIM) * v->edge, ones, low);
  v->count = 1;
  for (size_t k = 0; k < 3; k++) {
    const size_t cells = (size_t)(nsvcd__d3_axis(size, k) / v->edge) + 1;
    const size_t most = NSVCD__VOXELS + 1;
    v->sizes[k] = (cells < most ? cells : most) + 2 * NSVCD__VOXEL_RIM - 1;
    v->count *= v->sizes[k];
  }
  v->kinds = NSVCD__TAKE(arena, uint8_t, v->count);
  v->votes = NSVCD__TAKE(arena, int8_t, v->count);
  v->turns = NSVCD__TAKE(arena, int8_t, v->count);
  v->depths = NSVCD__TAKE(arena, float, v->count);
  uint32_t *queue = NSVCD__TAKE(arena, uint32_t, v->count);
  if (arena->failed) return 0;
  for (size_t axis = 0; axis < 3; axis++) {
    memset(v->turns, 0, v->count);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
      nsvcd__d3 corners[3];
      nsvcd__mesh_triangle(mesh, t, corners);
      nsvcd__mark_edge(v, corners[axis], corners[(axis + 1) % 3]);
      nsvcd__mark_crossings(v, corners, axis);
    }
    if (!is_open) nsvcd__count_votes(v, axis);
  }
  nsvcd__fill_outside(v, queue);
  nsvcd__measure_depths(v);
  return 1;
}
#endif
