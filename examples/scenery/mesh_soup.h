// mesh_soup.h - what the readers of PLY and GLB share: why a file is refused, numbers in text of any
// locale, and vertices and faces that come one by one. No stdio. Include neuralsvcd.h first.
#ifndef NSVCD_SCENERY_MESH_SOUP_H
#define NSVCD_SCENERY_MESH_SOUP_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct mesh_fault {
  const char *format;  // "OBJ": what the file was taken for, also where nothing is wrong
  size_t line;         // at fault, from 1; 0: none is
  const char *reason;  // NULL: nothing is wrong
} mesh_fault;

// Returns 0: `return mesh_refuse(...)` is how every reader fails. The first reason stays.
static inline int mesh_refuse(mesh_fault *fault, const char *reason) {
  if (!fault->reason) fault->reason = reason;
  return 0;
}

// A decimal number; passes it. Returns 0 where there is none.
static inline int mesh_number(const char **at, const char *end, double *out) {
  const char *p = *at;
  const int minus = p < end && *p == '-';
  double mantissa = 0;
  int digits = 0;
  double exponent = 0;
  p += p < end && (*p == '-' || *p == '+');
  for (int point = 0; p < end && ((*p >= '0' && *p <= '9') || (*p == '.' && !point)); p++) {
    if (*p == '.') {
      point = 1;
      continue;
    }
    digits = 1;
    // what follows the digits of a double only moves the point
    const int fits = mantissa < 1e17;
    if (fits) mantissa = 10 * mantissa + (*p - '0');
    exponent += !fits - point;
  }
  if (!digits) return 0;
  if (p < end && (*p | 32) == 'e') {
    int written = 0;
    const char *first = p + 1;
    const int down = first < end && *first == '-';
    first += first < end && (*first == '-' || *first == '+');
    for (p = first; p < end && *p >= '0' && *p <= '9'; p++) {
      if (written < 10000) written = 10 * written + (*p - '0');
    }
    if (p == first) return 0;
    exponent += down ? -written : written;
  }
  *at = p;
  if (mantissa == 0) exponent = 0;  // no infinity times it
  *out = (minus ? -mantissa : mantissa) * pow(10, exponent);
  if (exponent < 0) *out = (minus ? -mantissa : mantissa) / pow(10, -exponent);
  return 1;
}

// Words of a file in either order of bytes.
static inline uint64_t mesh_word(const unsigned char *at, size_t bytes, int big) {
  uint64_t word = 0;
  for (size_t k = 0; k < bytes; k++) word = word << 8 | at[big ? k : bytes - 1 - k];
  return word;
}

typedef struct mesh_soup {
  float *positions;           // (vertices, 3)
  uint32_t *corners, *sizes;  // faces: their corners, and how many each has
  size_t vertices, corner_count, faces;
  size_t room[3];                     // room for positions, corners and sizes
  const nsvcd_mesh_options *options;  // NULL: the numbers are metres
} mesh_soup;

static inline void mesh_soup_free(mesh_soup *soup) {
  free(soup->positions);
  free(soup->corners);
  free(soup->sizes);
}

#define MESH_SOUP_MOST ((size_t)1 << 30)  // bytes of an array

// Room for one more row. 0 without memory; what was there stays.
static inline int mesh_soup_grow(void *rows, size_t count, size_t *room, size_t row) {
  void **at = (void **)rows;
  if (count < *room) return 1;
  const size_t larger = *room ? 2 * *room : 256;
  void *grown = larger > MESH_SOUP_MOST / row ? NULL : realloc(*at, larger * row);
  if (!grown) return 0;
  *at = grown;
  *room = larger;
  return 1;
}
static inline int mesh_soup_vertex(mesh_soup *soup, const double *position) {
  if (!mesh_soup_grow(&soup->positions, soup->vertices, &soup->room[0], 3 * sizeof(float)))
    return 0;
  float *row = soup->positions + 3 * soup->vertices++;
  const nsvcd_mesh_options *o = soup->options;
  for (int k = 0; k < 3; k++) {
    const double own = o ? position[k] - o->origin[k] : position[k];
    const double metres = o && o->scale > 0 ? own * o->scale : own;
    // what no float can hold is not finite there, which the library refuses
    row[k] = fabs(metres) <= 3.4028234e38 ? (float)metres : HUGE_VALF;
  }
  return 1;
}
static inline int mesh_soup_corner(mesh_soup *soup, uint32_t vertex) {
  if (!mesh_soup_grow(&soup->corners, soup->corner_count, &soup->room[1], sizeof(uint32_t)))
    return 0;
  soup->corners[soup->corner_count++] = vertex;
  return 1;
}
// Adds a face of the last `size` corners.
static inline int mesh_soup_face(mesh_soup *soup, uint32_t size) {
  if (!mesh_soup_grow(&soup->sizes, soup->faces, &soup->room[2], sizeof(uint32_t))) return 0;
  soup->sizes[soup->faces++] = size;
  return 1;
}

// Returns 1, or 0 with a reason.
static inline int mesh_soup_finish(const mesh_soup *soup, const nsvcd_allocator *allocator,
                                   nsvcd_mesh *mesh, mesh_fault *fault) {
  nsvcd_faces faces;
  memset(&faces, 0, sizeof faces);
  faces.positions = soup->positions;
  faces.corners = soup->corners;
  faces.sizes = soup->sizes;
  faces.vertex_count = soup->vertices;
  faces.corner_count = soup->corner_count;
  faces.face_count = soup->faces;
  const nsvcd_result result = nsvcd_mesh_of_faces(&faces, allocator, mesh);
  return !result || mesh_refuse(fault, nsvcd_result_string(result));
}

#endif
