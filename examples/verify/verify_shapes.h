// SPDX-License-Identifier: MIT
// verify_shapes.h - of verify.c: the shapes of a planning file (examples/FORMATS.md) that are no
// meshes. What is round is a skeleton, a point, a segment or points, and a radius: it keeps a distance
// from something if the skeleton keeps that and the radius, and it holds or is held where the skeleton
// is. No triangle of a skeleton encloses anything.
#ifndef NSVCD_VERIFY_SHAPES_H
#define NSVCD_VERIFY_SHAPES_H
#include "verify_files.h"

#define SIDES 32  // of a cylinder

static void add_point(list *positions, double x, double y, double z) {
  add_float(positions, x);
  add_float(positions, y);
  add_float(positions, z);
}
static void add_triangle(list *indices, uint32_t a, uint32_t b, uint32_t c) {
  add_index(indices, a);
  add_index(indices, b);
  add_index(indices, c);
}

static void make_box(const double *size, list *positions, list *indices) {
  // of each side four corners, bit k of which says that they are on the positive side of axis k
  static const uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int n = 0; n < 8; n++)
    add_point(positions, n & 1 ? 0.5 * size[0] : -0.5 * size[0],
              n & 2 ? 0.5 * size[1] : -0.5 * size[1], n & 4 ? 0.5 * size[2] : -0.5 * size[2]);
  for (int n = 0; n < 6; n++) {
    add_triangle(indices, sides[n][0], sides[n][1], sides[n][2]);
    add_triangle(indices, sides[n][0], sides[n][2], sides[n][3]);
  }
}

// A prism about a cylinder: two rings of corners, and the middles of its ends.
static void make_cylinder(const double *size, list *positions, list *indices) {
  const double grown = size[0] * (1 + 1e-6) / cos(3.141592653589793 / SIDES);
  for (int n = 0; n < 2 * SIDES; n++) {
    const double angle = 6.283185307179586 * (n % SIDES + 0.5) / SIDES;
    add_point(positions, grown * cos(angle), grown * sin(angle),
              n < SIDES ? -0.5 * size[1] : 0.5 * size[1]);
  }
  add_point(positions, 0, 0, -0.5 * size[1]);
  add_point(positions, 0, 0, 0.5 * size[1]);
  for (uint32_t k = 0; k < SIDES; k++) {
    const uint32_t next = (k + 1) % SIDES;
    add_triangle(indices, 2 * SIDES, next, k);
    add_triangle(indices, k, next, SIDES + next);
    add_triangle(indices, k, SIDES + next, SIDES + k);
    add_triangle(indices, 2 * SIDES + 1, SIDES + k, SIDES + next);
  }
}

// The points of a text, the first three numbers of each line that has any.
static void make_cloud(const char *path, list *positions, list *indices) {
  char *words[MOST_WORDS];
  size_t size;
  char *text = read_file(path, &size);
  char *next = text;
  if (!text) fail(path, strerror(errno));
  if (size >= 4 && memcmp(text, "ply", 3) == 0) fail(path, "a PLY, which is not read");
  no_zero(path, text, size);
  for (size_t n = next_words(&next, words, MOST_WORDS); n > 0;
       n = next_words(&next, words, MOST_WORDS)) {
    const uint32_t point = (uint32_t)(positions->count / 3);
    if (n < 3) fail(path, "a point has fewer than three numbers");
    for (size_t k = 0; k < 3; k++) add_float(positions, number_of(path, words[k]));
    add_triangle(indices, point, point, point);
  }
  free(text);
}

// How shapes begin, and how many numbers they have; that of a cloud follows a path.
static const struct {
  const char *word;
  size_t numbers;
  int is_round;
} shapes[5] = {
    {"sphere:", 1, 1}, {"capsule:", 2, 1}, {"box:", 3, 0}, {"cylinder:", 2, 0}, {"cloud:", 1, 1}};
#define SPHERE 0
#define CAPSULE 1
#define BOX 2
#define CYLINDER 3
#define CLOUD 4
#define MESH 5

static size_t shape_at(const char *word) {
  size_t n = 0;
  while (n < MESH && strcmp(shapes[n].word, word) != 0) n++;
  return n;
}

// How many words the shape has that begins with this one.
static size_t shape_words(const char *word) {
  const size_t n = shape_at(word);
  return n == MESH ? 1 : 1 + shapes[n].numbers + (n == CLOUD);
}

// The mesh of a shape; of one that is round the skeleton, and *radius. scale: of a mesh.
static const nsvcd_verify_mesh *shape_of_words(const char *file, char *const *words,
                                               const double *scale, double *radius) {
  list positions = {NULL, 0, 0};
  list indices = {NULL, 0, 0};
  double size[3] = {0, 0, 0};
  const size_t n = shape_at(words[0]);
  *radius = 0;
  if (n == MESH) return mesh_of_file(file, words[0], scale);
  for (size_t k = 0; k < shapes[n].numbers; k++) {
    size[k] = number_of(file, words[1 + (n == CLOUD) + k]);
    if (!(size[k] > 0 && size[k] <= 1e6)) fail(file, "a size is not positive, or too large");
  }
  if (shapes[n].is_round) *radius = size[0];
  if (n == SPHERE || n == CAPSULE) {
    add_point(&positions, 0, 0, -0.5 * size[1]);
    if (n == CAPSULE) add_point(&positions, 0, 0, 0.5 * size[1]);
    add_triangle(&indices, 0, n == CAPSULE, n == CAPSULE);
  }
  if (n == BOX) make_box(size, &positions, &indices);
  if (n == CYLINDER) make_cylinder(size, &positions, &indices);
  if (n == CLOUD) {
    char path[4096];
    path_from(file, words[1], path, sizeof path);
    make_cloud(path, &positions, &indices);
  }
  nsvcd_verify_mesh *mesh = (nsvcd_verify_mesh *)allocate(sizeof *mesh);
  build_mesh(file, &positions, &indices, mesh);
  return mesh;
}
#endif  // NSVCD_VERIFY_SHAPES_H
