// In: heights on a grid, some of them missing. Out: a mesh of the surface through them.
#pragma once
#include "mesh.h"

#ifndef NSVCD_NO_ENCODER
// Is it NaN? By its bits, so that it holds under -ffast-math too.
static int nsvcd__is_hole(float height) {
  return nsvcd__magnitude(height) > 0x7f800000u;
}

// Writes the triangles of a grid, or, if it is NULL, only counts them.
static size_t nsvcd__grid_triangles(const float *heights, size_t rows, size_t columns,
                                    uint32_t *indices) {
  size_t count = 0;
  // of the sample in the row, and of the one beside it in the next: how many before are no holes
  uint32_t this_row = 0;
  uint32_t next_row = 0;
  for (size_t i = 0; i < columns; i++) next_row += !nsvcd__is_hole(heights[i]);
  for (size_t row = 0; row + 1 < rows; row++) {
    for (size_t column = 0; column < columns; column++) {
      const float *here = heights + row * columns + column;
      const uint32_t is_here = !nsvcd__is_hole(here[0]);
      const uint32_t is_next = !nsvcd__is_hole(here[columns]);
      // the cell's corners that are there, counter-clockwise
      uint32_t corners[4];
      size_t found = 0;
      if (is_here) corners[found++] = this_row;
      this_row += is_here;
      next_row += is_next;
      if (column + 1 == columns) continue;
      if (!nsvcd__is_hole(here[1])) corners[found++] = this_row;
      if (!nsvcd__is_hole(here[columns + 1])) corners[found++] = next_row;
      if (is_next) corners[found++] = next_row - 1;
      for (size_t k = 2; k < found; k++, count++) {
        if (!indices) continue;
        indices[3 * count] = corners[0];
        indices[3 * count + 1] = corners[k - 1];
        indices[3 * count + 2] = corners[k];
      }
    }
  }
  return count;
}

NSVCDDEF nsvcd_result nsvcd_mesh_of_heights(const float *heights, size_t rows, size_t columns,
                                            const float step[2], const nsvcd_allocator *alloc,
                                            nsvcd_mesh *mesh) {
  if (!heights || !step || !mesh) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 2; k++) {
    if (!nsvcd__is_finite(step[k]) || !(step[k] > 0)) return NSVCD_ERROR_SCALE;
  }
  if (rows < 2 || columns < 2) return NSVCD_ERROR_EMPTY;
  if (rows > NSVCD__MAX_COUNT / 2 / columns) return NSVCD_ERROR_TOO_LARGE;
  size_t vertices = 0;
  for (size_t i = 0; i < rows * columns; i++) {
    if (nsvcd__is_hole(heights[i])) continue;
    if (!nsvcd__in_range(heights + i, 1, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
    vertices++;
  }
  const double most = (double)NSVCD_MAX_COORDINATE;
  if ((double)(columns - 1) * (double)step[0] > most) return NSVCD_ERROR_NUMBER;
  if ((double)(rows - 1) * (double)step[1] > most) return NSVCD_ERROR_NUMBER;
  const size_t triangles = nsvcd__grid_triangles(heights, rows, columns, NULL);
  if (triangles == 0) return NSVCD_ERROR_EMPTY;
  nsvcd_mesh out;
  if (!nsvcd__mesh_alloc(&out, vertices, triangles, alloc)) {
    nsvcd_mesh_free(&out, alloc);
    return NSVCD_ERROR_MEMORY;
  }
  (void)nsvcd__grid_triangles(heights, rows, columns, out.indices);
  float *position = out.positions;
  for (size_t i = 0; i < rows * columns; i++) {
    if (nsvcd__is_hole(heights[i])) continue;
    *position++ = (float)((double)(i % columns) * (double)step[0]);
    *position++ = (float)((double)(i / columns) * (double)step[1]);
    *position++ = heights[i];
  }
  *mesh = out;
  return NSVCD_OK;
}
#endif
