// shapes.h - closed triangle meshes made by a few lines of code, for the demos, the tests and the
// problem generator.
//
// Every function appends closed, outward-wound parts to a shapes_mesh. A union is simply several
// overlapping closed parts one after the other: internal surfaces do no harm. Everything hangs on
// two makers: shapes_lathe (a profile turned about z) and shapes_tube (a disc drawn along a curve),
// plus boxes and extruded polygons. Deterministic: the same seed gives the same mesh. Units are
// metres; sizes are full extents unless called radius. Without memory a mesh sets `failed` and
// ignores what follows.
#ifndef NSVCD_SCENERY_SHAPES_H
#define NSVCD_SCENERY_SHAPES_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define SHAPES_DEF static __attribute__((unused))
#else
#define SHAPES_DEF static
#endif
#define SHAPES_PI 3.14159265358979323846

// ---------------------------------------------------------------------------------- random numbers

typedef struct shapes_rng {
  uint64_t state;
} shapes_rng;

SHAPES_DEF uint64_t shapes_next(shapes_rng *rng) {  // splitmix64
  uint64_t z = rng->state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}
SHAPES_DEF double shapes_uniform(shapes_rng *rng, double low, double high) {
  return low + (high - low) * ((double)(shapes_next(rng) >> 11) / 9007199254740992.0);
}
SHAPES_DEF int shapes_pick(shapes_rng *rng, int count) {
  return (int)(shapes_next(rng) % (uint64_t)count);
}
SHAPES_DEF double shapes_normal(shapes_rng *rng) {  // Box-Muller
  double u = 1 - shapes_uniform(rng, 0, 1);
  double v = shapes_uniform(rng, 0, 1);
  return sqrt(-2 * log(u)) * cos(2 * SHAPES_PI * v);
}
SHAPES_DEF void shapes_direction(shapes_rng *rng, double *out) {
  double n = 0;
  while (n < 1e-6) {
    for (int i = 0; i < 3; i++) out[i] = shapes_normal(rng);
    n = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
  }
  for (int i = 0; i < 3; i++) out[i] /= n;
}
SHAPES_DEF void shapes_quaternion(shapes_rng *rng, double *q) {  // uniform over rotations, x y z w
  double n = 0;
  while (n < 1e-6) {
    for (int i = 0; i < 4; i++) q[i] = shapes_normal(rng);
    n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  }
  for (int i = 0; i < 4; i++) q[i] /= n;
}

// -------------------------------------------------------------------------------------------- mesh

typedef struct shapes_mesh {
  double *positions;  // (vertices, 3)
  uint32_t *indices;  // (triangles, 3)
  size_t vertices, triangles, vertex_capacity, triangle_capacity;
  int failed;  // no memory
} shapes_mesh;

SHAPES_DEF void shapes_free(shapes_mesh *mesh) {
  free(mesh->positions);
  free(mesh->indices);
  memset(mesh, 0, sizeof *mesh);
}
SHAPES_DEF uint32_t shapes_vertex(shapes_mesh *mesh, double x, double y, double z) {
  if (mesh->vertices == mesh->vertex_capacity) {
    size_t capacity = mesh->vertex_capacity ? 2 * mesh->vertex_capacity : 256;
    double *grown = (double *)realloc(mesh->positions, 3 * capacity * sizeof(double));
    if (!grown) {
      mesh->failed = 1;
      return 0;
    }
    mesh->positions = grown;
    mesh->vertex_capacity = capacity;
  }
  double *p = mesh->positions + 3 * mesh->vertices;
  p[0] = x;
  p[1] = y;
  p[2] = z;
  return (uint32_t)mesh->vertices++;
}
SHAPES_DEF void shapes_triangle(shapes_mesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
  if (mesh->triangles == mesh->triangle_capacity) {
    size_t capacity = mesh->triangle_capacity ? 2 * mesh->triangle_capacity : 512;
    uint32_t *grown = (uint32_t *)realloc(mesh->indices, 3 * capacity * sizeof(uint32_t));
    if (!grown) {
      mesh->failed = 1;
      return;
    }
    mesh->indices = grown;
    mesh->triangle_capacity = capacity;
  }
  uint32_t *t = mesh->indices + 3 * mesh->triangles++;
  t[0] = a;
  t[1] = b;
  t[2] = c;
}
SHAPES_DEF void shapes_quad(shapes_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  shapes_triangle(mesh, a, b, c);
  shapes_triangle(mesh, a, c, d);
}
// Rotates (quaternion x y z w, NULL: not) and then moves all vertices from `first` on.
SHAPES_DEF void shapes_place(shapes_mesh *mesh, size_t first, const double *q, double x, double y,
                             double z) {
  for (size_t i = first; i < mesh->vertices; i++) {
    double *p = mesh->positions + 3 * i;
    if (q) {  // p + 2 q x (q x p + w p)
      double a = q[1] * p[2] - q[2] * p[1] + q[3] * p[0],
             b = q[2] * p[0] - q[0] * p[2] + q[3] * p[1];
      double c = q[0] * p[1] - q[1] * p[0] + q[3] * p[2];
      double dx = q[1] * c - q[2] * b;
      double dy = q[2] * a - q[0] * c;
      double dz = q[0] * b - q[1] * a;
      p[0] += 2 * dx;
      p[1] += 2 * dy;
      p[2] += 2 * dz;
    }
    p[0] += x;
    p[1] += y;
    p[2] += z;
  }
}
// Turns parts inside out: the inner wall of a cavity.
SHAPES_DEF void shapes_flip(shapes_mesh *mesh, size_t first_triangle) {
  for (size_t i = first_triangle; i < mesh->triangles; i++) {
    uint32_t *t = mesh->indices + 3 * i;
    uint32_t swap = t[1];
    t[1] = t[2];
    t[2] = swap;
  }
}
SHAPES_DEF void shapes_bounds(const shapes_mesh *mesh, double *low, double *high) {
  for (size_t k = 0; k < 3; k++) {
    low[k] = HUGE_VAL;
    high[k] = -HUGE_VAL;
    for (size_t i = 0; i < mesh->vertices; i++) {
      low[k] = fmin(low[k], mesh->positions[3 * i + k]);
      high[k] = fmax(high[k], mesh->positions[3 * i + k]);
    }
  }
}
// Centres the mesh on its bounds and makes its largest extent `extent`.
SHAPES_DEF void shapes_fit(shapes_mesh *mesh, double extent) {
  double low[3], high[3];
  shapes_bounds(mesh, low, high);
  double size = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
  double scale = size > 0 ? extent / size : 1;
  for (size_t i = 0; i < 3 * mesh->vertices; i++)
    mesh->positions[i] = (mesh->positions[i] - (low[i % 3] + high[i % 3]) / 2) * scale;
}
// Returns 1, or 0 if the file cannot be written. %.9g: a float survives the trip, equal vertices
// stay equal.
SHAPES_DEF int shapes_write_obj(const shapes_mesh *mesh, const char *path) {
  FILE *file = fopen(path, "w");
  if (!file) return 0;
  for (size_t i = 0; i < mesh->vertices; i++) {
    const double *p = mesh->positions + 3 * i;
    fprintf(file, "v %.9g %.9g %.9g\n", p[0], p[1], p[2]);
  }
  for (size_t i = 0; i < mesh->triangles; i++) {
    const uint32_t *t = mesh->indices + 3 * i;
    fprintf(file, "f %lu %lu %lu\n", (unsigned long)t[0] + 1, (unsigned long)t[1] + 1,
            (unsigned long)t[2] + 1);
  }
  int ok = !ferror(file);
  return fclose(file) == 0 && ok;
}

// ------------------------------------------------------------------------------------------ makers

// Box about the origin, each edge cut into `cuts` pieces.
SHAPES_DEF void shapes_box(shapes_mesh *mesh, double x, double y, double z, int cuts) {
  double size[3] = {x, y, z};
  for (int face = 0; face < 6; face++) {
    int w = face / 2;
    int u = (w + 1) % 3;
    int v = (w + 2) % 3;
    uint32_t base = (uint32_t)mesh->vertices;
    uint32_t row = (uint32_t)cuts + 1;
    for (int j = 0; j <= cuts; j++)
      for (int i = 0; i <= cuts; i++) {
        double p[3];
        p[u] = size[u] * ((2 * i - cuts) / (2.0 * cuts));
        p[v] = size[v] * ((2 * j - cuts) / (2.0 * cuts));
        p[w] = (face % 2 ? -0.5 : 0.5) * size[w];
        shapes_vertex(mesh, p[0], p[1], p[2]);
      }
    for (uint32_t j = 0; j + 1 < row; j++)
      for (uint32_t i = 0; i + 1 < row; i++) {
        uint32_t a = base + j * row + i;
        uint32_t b = a + 1;
        uint32_t c = b + row;
        uint32_t d = a + row;
        if (face % 2)
          shapes_quad(mesh, a, d, c, b);
        else
          shapes_quad(mesh, a, b, c, d);
      }
  }
}
SHAPES_DEF void shapes_box_at(shapes_mesh *mesh, double x, double y, double z, double dx, double dy,
                              double dz) {
  size_t first = mesh->vertices;
  shapes_box(mesh, dx, dy, dz, 1);
  shapes_place(mesh, first, NULL, x, y, z);
}
// Turns a profile of `count` points (radius, z) about z. The profile runs with the solid on its
// left when radius points right: upwards along the outside. It starts and ends on the axis (radius
// 0), or is a loop (closed = 1).
SHAPES_DEF void shapes_lathe(shapes_mesh *mesh, const double (*profile)[2], int count, int segments,
                             int closed) {
  uint32_t base = (uint32_t)mesh->vertices;
  uint32_t n = (uint32_t)segments;
  for (int i = 0; i < count; i++)  // on the axis: the pole, repeated
    for (int s = 0; s < segments; s++) {
      double angle = 2 * SHAPES_PI * s / segments;
      double r = profile[i][0] > 0 ? profile[i][0] : 0;
      shapes_vertex(mesh, r * cos(angle), r * sin(angle), profile[i][1]);
    }
  for (int i = 0; i < (closed ? count : count - 1); i++) {
    int j = (i + 1) % count;
    int lower_pole = profile[i][0] <= 0;
    int upper_pole = profile[j][0] <= 0;
    for (uint32_t s = 0; s < n; s++) {
      uint32_t a = base + (uint32_t)i * n + s;
      uint32_t b = base + (uint32_t)i * n + (s + 1) % n;
      uint32_t d = base + (uint32_t)j * n + s;
      uint32_t c = base + (uint32_t)j * n + (s + 1) % n;
      if (!lower_pole) shapes_triangle(mesh, a, b, upper_pole ? d : c);
      if (!upper_pole) shapes_triangle(mesh, a, c, d);
    }
  }
}
// Draws a disc of `sides` corners along `count` points (x, y, z); ends are capped unless closed.
// Frames by parallel transport; on a closed curve the remaining twist is spread evenly.
SHAPES_DEF void shapes_tube(shapes_mesh *mesh, const double (*path)[3], int count, double radius,
                            int sides, int closed) {
  uint32_t base = (uint32_t)mesh->vertices;
  uint32_t n = (uint32_t)sides;
  double side[3] = {0, 0, 0};
  double first_side[3] = {0, 0, 0};
  double twist = 0;
  // pass 0 only measures the twist of a closed curve
  for (int pass = closed ? 0 : 1; pass < 2; pass++)
    for (int i = 0; i < count + (pass == 0); i++) {
      const double *p = path[i % count];
      const double *q0 = path[(i + count - 1) % count];
      const double *q1 = path[(i + 1) % count];
      if (!closed && i == 0) q0 = p;
      if (!closed && i == count - 1) q1 = p;
      double t[3] = {q1[0] - q0[0], q1[1] - q0[1], q1[2] - q0[2]};
      double length = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
      for (int k = 0; k < 3; k++) t[k] /= length;
      if (i == 0) {
        int axis = fabs(t[0]) < fabs(t[1]) ? (fabs(t[0]) < fabs(t[2]) ? 0 : 2)
                                           : (fabs(t[1]) < fabs(t[2]) ? 1 : 2);
        for (int k = 0; k < 3; k++) side[k] = k == axis;
      }
      double along = side[0] * t[0] + side[1] * t[1] + side[2] * t[2];
      double norm = 0;
      for (int k = 0; k < 3; k++) {
        side[k] -= along * t[k];
        norm += side[k] * side[k];
      }
      for (int k = 0; k < 3; k++) side[k] /= sqrt(norm);
      double up[3] = {t[1] * side[2] - t[2] * side[1], t[2] * side[0] - t[0] * side[2],
                      t[0] * side[1] - t[1] * side[0]};
      if (i == 0) memcpy(first_side, side, sizeof side);
      if (pass == 0) {
        if (i == count)
          twist =
              atan2(up[0] * first_side[0] + up[1] * first_side[1] + up[2] * first_side[2],
                    side[0] * first_side[0] + side[1] * first_side[1] + side[2] * first_side[2]);
        continue;
      }
      for (int s = 0; s < sides; s++) {
        double angle = 2 * SHAPES_PI * s / sides + (closed ? twist * i / count : 0);
        double c = radius * cos(angle);
        double d = radius * sin(angle);
        shapes_vertex(mesh, p[0] + c * side[0] + d * up[0], p[1] + c * side[1] + d * up[1],
                      p[2] + c * side[2] + d * up[2]);
      }
    }
  for (int i = 0; i < (closed ? count : count - 1); i++)
    for (uint32_t s = 0; s < n; s++) {
      uint32_t here = base + (uint32_t)i * n;
      uint32_t next = base + (uint32_t)((i + 1) % count) * n;
      shapes_quad(mesh, here + s, here + (s + 1) % n, next + (s + 1) % n, next + s);
    }
  for (uint32_t s = 1; !closed && s + 1 < n; s++) {
    uint32_t last = base + (uint32_t)(count - 1) * n;
    shapes_triangle(mesh, base, base + s + 1, base + s);
    shapes_triangle(mesh, last, last + s, last + s + 1);
  }
}
SHAPES_DEF void shapes_rod_between(shapes_mesh *mesh, const double *a, const double *b,
                                   double radius, int sides) {
  double path[2][3];
  for (int i = 0; i < 3; i++) {
    path[0][i] = a[i];
    path[1][i] = b[i];
  }
  shapes_tube(mesh, (const double(*)[3])path, 2, radius, sides, 0);
}
SHAPES_DEF double shapes_area2(const double *a, const double *b, const double *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
// Is the corner at `at` of the remaining polygon an ear?
SHAPES_DEF int shapes_is_ear(const double (*p)[2], const int *left, int count, int at) {
  int a = left[(at + count - 1) % count];
  int b = left[at];
  int c = left[(at + 1) % count];
  if (shapes_area2(p[a], p[b], p[c]) <= 0) return 0;
  for (int i = 0; i < count; i++) {
    int x = left[i];
    if (x == a || x == b || x == c) continue;
    if (shapes_area2(p[a], p[b], p[x]) >= 0 && shapes_area2(p[b], p[c], p[x]) >= 0 &&
        shapes_area2(p[c], p[a], p[x]) >= 0)
      return 0;
  }
  return 1;
}
#define SHAPES_MAX_POLYGON 128
// Extrudes a simple counter-clockwise polygon (concave allowed, at most SHAPES_MAX_POLYGON corners)
// over z in [-h/2, h/2].
SHAPES_DEF void shapes_extrude(shapes_mesh *mesh, const double (*polygon)[2], int count,
                               double height) {
  uint32_t base = (uint32_t)mesh->vertices;
  uint32_t n = (uint32_t)count;
  int left[SHAPES_MAX_POLYGON];
  int remaining = count;
  for (int i = 0; i < 2 * count; i++)
    shapes_vertex(mesh, polygon[i % count][0], polygon[i % count][1],
                  i < count ? -height / 2 : height / 2);
  for (uint32_t i = 0; i < n; i++)
    shapes_quad(mesh, base + i, base + (i + 1) % n, base + n + (i + 1) % n, base + n + i);
  for (int i = 0; i < count; i++) left[i] = i;
  while (remaining > 2) {  // ear clipping
    int at = 0;
    while (at < remaining - 1 && !shapes_is_ear(polygon, left, remaining, at)) at++;
    uint32_t a = base + (uint32_t)left[(at + remaining - 1) % remaining];
    uint32_t b = base + (uint32_t)left[at];
    uint32_t c = base + (uint32_t)left[(at + 1) % remaining];
    shapes_triangle(mesh, a, c, b);
    shapes_triangle(mesh, a + n, b + n, c + n);
    memmove(left + at, left + at + 1, (size_t)(remaining - at - 1) * sizeof(int));
    remaining--;
  }
}

// ------------------------------------------------------------------------------------------ solids

#define SHAPES_MAX_PROFILE 64

SHAPES_DEF void shapes_cylinder(shapes_mesh *mesh, double radius, double height, int segments) {
  double p[4][2] = {{0, -height / 2}, {radius, -height / 2}, {radius, height / 2}, {0, height / 2}};
  shapes_lathe(mesh, (const double(*)[2])p, 4, segments, 0);
}
// A cone, or with top > 0 a frustum.
SHAPES_DEF void shapes_cone(shapes_mesh *mesh, double bottom, double top, double height,
                            int segments) {
  double p[4][2] = {{0, -height / 2}, {bottom, -height / 2}, {top, height / 2}, {0, height / 2}};
  shapes_lathe(mesh, (const double(*)[2])p, top > 0 ? 4 : 3, segments, 0);
}
// `length` is that of the straight part; 0 gives a sphere.
SHAPES_DEF void shapes_capsule(shapes_mesh *mesh, double radius, double length, int segments) {
  double p[SHAPES_MAX_PROFILE][2];
  int rings = segments / 4 > 2 ? segments / 4 : 2;
  int n = 0;
  if (rings > SHAPES_MAX_PROFILE / 2 - 1) rings = SHAPES_MAX_PROFILE / 2 - 1;
  for (int half = 0; half < 2; half++)
    for (int i = 0; i <= rings; i++) {
      double angle = SHAPES_PI / 2 * ((double)i / rings - (half ? 0 : 1));
      if (half && i == 0 && length <= 0) continue;
      p[n][0] = (half && i == rings) || (!half && i == 0) ? 0 : radius * cos(angle);
      p[n++][1] = radius * sin(angle) + (half ? length / 2 : -length / 2);
    }
  shapes_lathe(mesh, (const double(*)[2])p, n, segments, 0);
}
SHAPES_DEF void shapes_ellipsoid(shapes_mesh *mesh, double rx, double ry, double rz, int segments) {
  size_t first = mesh->vertices;
  shapes_capsule(mesh, 1, 0, segments);
  for (size_t i = first; i < mesh->vertices; i++) {
    double *p = mesh->positions + 3 * i;
    p[0] *= rx;
    p[1] *= ry;
    p[2] *= rz;
  }
}
SHAPES_DEF void shapes_torus(shapes_mesh *mesh, double ring, double tube, int segments, int sides) {
  double p[SHAPES_MAX_PROFILE][2];
  if (sides > SHAPES_MAX_PROFILE) sides = SHAPES_MAX_PROFILE;
  for (int i = 0; i < sides; i++) {
    p[i][0] = ring + tube * cos(2 * SHAPES_PI * i / sides);
    p[i][1] = tube * sin(2 * SHAPES_PI * i / sides);
  }
  shapes_lathe(mesh, (const double(*)[2])p, sides, segments, 1);
}
// A pipe open at both ends; low ones are rings and washers.
SHAPES_DEF void shapes_ring(shapes_mesh *mesh, double outer, double inner, double height,
                            int segments) {
  double p[4][2] = {
      {inner, -height / 2}, {outer, -height / 2}, {outer, height / 2}, {inner, height / 2}};
  shapes_lathe(mesh, (const double(*)[2])p, 4, segments, 1);
}
SHAPES_DEF void shapes_prism(shapes_mesh *mesh, double radius, double height, int corners) {
  shapes_cylinder(mesh, radius, height, corners);
}
SHAPES_DEF void shapes_l_bracket(shapes_mesh *mesh, double x, double y, double thickness,
                                 double height) {
  double p[6][2] = {{0, 0}, {x, 0}, {x, thickness}, {thickness, thickness}, {thickness, y}, {0, y}};
  shapes_extrude(mesh, (const double(*)[2])p, 6, height);
}
// A block with a slot cut into its upper edge: a U.
SHAPES_DEF void shapes_slot(shapes_mesh *mesh, double width, double height, double depth,
                            double gap, double floor) {
  double g = gap / 2;
  double w = width / 2;
  double p[8][2] = {{-w, 0},    {w, 0},      {w, height},  {g, height},
                    {g, floor}, {-g, floor}, {-g, height}, {-w, height}};
  shapes_extrude(mesh, (const double(*)[2])p, 8, depth);
}
// A peg: shaft, shoulder and chamfered tip.
SHAPES_DEF void shapes_peg(shapes_mesh *mesh, double radius, double length, int segments) {
  double r = radius;
  double p[7][2] = {{0, 0},
                    {1.6 * r, 0},
                    {1.6 * r, 0.15 * length},
                    {r, 0.15 * length},
                    {r, 0.92 * length},
                    {0.7 * r, length},
                    {0, length}};
  shapes_lathe(mesh, (const double(*)[2])p, 7, segments, 0);
}
SHAPES_DEF void shapes_gear(shapes_mesh *mesh, double radius, double tooth, double height,
                            int teeth) {
  double p[SHAPES_MAX_POLYGON][2];
  if (teeth > SHAPES_MAX_POLYGON / 4) teeth = SHAPES_MAX_POLYGON / 4;
  for (int i = 0; i < 4 * teeth; i++) {
    double r = i % 4 < 2 ? radius : radius - tooth;
    double angle = 2 * SHAPES_PI * i / (4 * teeth);
    p[i][0] = r * cos(angle);
    p[i][1] = r * sin(angle);
  }
  shapes_extrude(mesh, (const double(*)[2])p, 4 * teeth, height);
}
// A random star-shaped polygon, extruded.
SHAPES_DEF void shapes_slab(shapes_mesh *mesh, shapes_rng *rng, double radius, double height) {
  double p[SHAPES_MAX_POLYGON][2];
  int count = 4 + shapes_pick(rng, 9);
  for (int i = 0; i < count; i++) {
    double r = radius * shapes_uniform(rng, 0.45, 1);
    double angle = 2 * SHAPES_PI * (i + shapes_uniform(rng, -0.3, 0.3)) / count;
    p[i][0] = r * cos(angle);
    p[i][1] = r * sin(angle);
  }
  shapes_extrude(mesh, (const double(*)[2])p, count, height);
}
// trefoil
SHAPES_DEF void shapes_knot(shapes_mesh *mesh, double radius, double tube, int segments,
                            int sides) {
  double path[256][3];
  if (segments > 256) segments = 256;
  for (int i = 0; i < segments; i++) {
    double t = 2 * SHAPES_PI * i / segments;
    double s = radius / 3;
    path[i][0] = s * (sin(t) + 2 * sin(2 * t));
    path[i][1] = s * (cos(t) - 2 * cos(2 * t));
    path[i][2] = -s * sin(3 * t);
  }
  shapes_tube(mesh, (const double(*)[3])path, segments, tube, sides, 1);
}
SHAPES_DEF void shapes_bottle(shapes_mesh *mesh, double radius, double height, int segments) {
  double r = radius;
  double h = height;
  double p[10][2] = {{0, 0},
                     {0.9 * r, 0},
                     {r, 0.05 * h},
                     {r, 0.55 * h},
                     {0.85 * r, 0.68 * h},
                     {0.45 * r, 0.8 * h},
                     {0.35 * r, 0.85 * h},
                     {0.35 * r, 0.97 * h},
                     {0.3 * r, h},
                     {0, h}};
  shapes_lathe(mesh, (const double(*)[2])p, 10, segments, 0);
}

// ----------------------------------------------------------------------------------------- hollows
// All stand on z = 0 and open upwards.

// A cup of wall thickness `wall`; `flare` is the mouth's radius over the foot's.
SHAPES_DEF void shapes_cup(shapes_mesh *mesh, double radius, double height, double wall,
                           double flare, int segments) {
  double top = radius * flare;
  double p[6][2] = {
      {0, 0}, {radius, 0}, {top, height}, {top - wall, height}, {radius - wall, wall}, {0, wall}};
  shapes_lathe(mesh, (const double(*)[2])p, 6, segments, 0);
}
SHAPES_DEF void shapes_mug(shapes_mesh *mesh, double radius, double height, double wall,
                           int segments) {
  double path[17][3];
  shapes_cup(mesh, radius, height, wall, 1, segments);
  for (int i = 0; i < 17; i++) {  // the ends of the handle reach into the wall, not through it
    double angle = SHAPES_PI * (i / 16.0 - 0.5);
    path[i][0] = radius - wall / 2 + 0.6 * radius * cos(angle);
    path[i][1] = 0;
    path[i][2] = height * (0.5 + 0.32 * sin(angle));
  }
  shapes_tube(mesh, (const double(*)[3])path, 17, fmin(0.9 * wall, 0.1 * height), 8, 0);
}
SHAPES_DEF void shapes_bowl(shapes_mesh *mesh, double radius, double depth, double wall,
                            int segments) {
  double p[18][2];
  for (int i = 0; i < 9; i++) {
    double angle = SHAPES_PI / 2 * i / 8;
    p[i][0] = i ? radius * sin(angle) : 0;
    p[i][1] = depth * (1 - cos(angle));
    p[17 - i][0] = i ? (radius - wall) * sin(angle) : 0;
    p[17 - i][1] = depth - (depth - wall) * cos(angle);
  }
  shapes_lathe(mesh, (const double(*)[2])p, 18, segments, 0);
}
SHAPES_DEF void shapes_plate(shapes_mesh *mesh, double radius, double height, double wall,
                             int segments) {
  double r = radius;
  double w = wall;
  double p[8][2] = {{0, 0},      {0.6 * r, 0},       {0.95 * r, height - w}, {r, height - w},
                    {r, height}, {0.93 * r, height}, {0.58 * r, w},          {0, w}};
  shapes_lathe(mesh, (const double(*)[2])p, 8, segments, 0);
}
// A drawer, tray or crate: five boards.
SHAPES_DEF void shapes_drawer(shapes_mesh *mesh, double x, double y, double z, double wall) {
  shapes_box_at(mesh, 0, 0, wall / 2, x, y, wall);
  for (int s = -1; s <= 1; s += 2) {
    shapes_box_at(mesh, s * (x - wall) / 2, 0, z / 2, wall, y, z);
    shapes_box_at(mesh, 0, s * (y - wall) / 2, z / 2, x, wall, z);
  }
}
SHAPES_DEF void shapes_shelf(shapes_mesh *mesh, double x, double y, double z, double wall,
                             int boards, int back) {
  for (int s = -1; s <= 1; s += 2) shapes_box_at(mesh, s * (x - wall) / 2, 0, z / 2, wall, y, z);
  for (int i = 0; i < boards; i++)
    shapes_box_at(mesh, 0, 0, wall / 2 + (z - wall) * i / (boards - 1), x, y, wall);
  if (back) shapes_box_at(mesh, 0, (y - wall) / 2, z / 2, x, wall, z);
}
SHAPES_DEF void shapes_chair(shapes_mesh *mesh, double width, double height, double leg) {
  double w = width;
  double seat = 0.45 * height;
  shapes_box_at(mesh, 0, 0, seat, w, w, leg);
  for (int sx = -1; sx <= 1; sx += 2)
    for (int sy = -1; sy <= 1; sy += 2) {
      double top = sy > 0 ? height : seat;
      shapes_box_at(mesh, sx * (w - leg) / 2, sy * (w - leg) / 2, top / 2, leg, leg, top);
    }
  for (int i = 0; i < 3; i++)
    shapes_box_at(mesh, 0, (w - leg) / 2, seat + (height - seat) * (i + 1.5) / 4.6, w, 0.6 * leg,
                  0.8 * leg);
}
// reach: how far the two long wires of its frame stand out beyond the others. At 0 the ends of two
// wires share an edge.
SHAPES_DEF void shapes_dish_rack(shapes_mesh *mesh, double x, double y, double height, double wire,
                                 double reach, int slots, int sides) {
  for (int s = -1; s <= 1; s += 2) {
    double a[3] = {-x / 2 - reach, s * y / 2, wire};
    double b[3] = {x / 2 + reach, s * y / 2, wire};
    double c[3] = {s * x / 2, -y / 2, wire};
    double d[3] = {s * x / 2, y / 2, wire};
    shapes_rod_between(mesh, a, b, wire, sides);
    shapes_rod_between(mesh, c, d, wire, sides);
    for (int i = 0; i < slots; i++) {
      double at = -x / 2 + x * (i + 0.5) / slots;
      double foot[3] = {at, s * y / 4, wire};
      double tip[3] = {at, s * y / 2.4, height};
      shapes_rod_between(mesh, foot, tip, wire, sides);
    }
  }
  for (int i = 0; i < slots; i++) {
    double at = -x / 2 + x * (i + 0.5) / slots;
    double a[3] = {at, -y / 2, wire};
    double b[3] = {at, y / 2, wire};
    shapes_rod_between(mesh, a, b, wire, sides);
  }
}
// Rings and upright ribs about a floor.
SHAPES_DEF void shapes_basket(shapes_mesh *mesh, double radius, double height, double wire,
                              int ribs, int segments) {
  shapes_cylinder(mesh, radius, 2 * wire, segments);
  for (int i = 0; i < 3; i++) {
    size_t first = mesh->vertices;
    shapes_torus(mesh, radius * (1 + 0.1 * i), wire, segments, 6);
    shapes_place(mesh, first, NULL, 0, 0, height * i / 2);
  }
  for (int i = 0; i < ribs; i++) {
    double angle = 2 * SHAPES_PI * i / ribs;
    double c = radius * cos(angle);
    double s = radius * sin(angle);
    double a[3] = {c, s, 0};
    double b[3] = {1.2 * c, 1.2 * s, height};
    shapes_rod_between(mesh, a, b, wire, 6);
  }
}
// Closed all round, with a cavity: an outer surface and an inner one turned inside out. round:
// ellipsoids, else boxes.
SHAPES_DEF void shapes_shell(shapes_mesh *mesh, double x, double y, double z, double wall,
                             int round, int segments) {
  for (int inner = 0; inner < 2; inner++) {
    size_t first = mesh->triangles;
    double w = inner ? 2 * wall : 0;
    if (round)
      shapes_ellipsoid(mesh, (x - w) / 2, (y - w) / 2, (z - w) / 2, segments);
    else
      shapes_box(mesh, x - w, y - w, z - w, 2);
    if (inner) shapes_flip(mesh, first);
  }
}

// ----------------------------------------------------------------------------------- random shapes

// One primitive of about `size` metres, in random proportions. detail: 0 coarse to 2 fine.
SHAPES_DEF void shapes_random_part(shapes_mesh *mesh, shapes_rng *rng, double size, int detail) {
  int n = (detail == 0 ? 8 : detail == 1 ? 16 : 28) + 2 * shapes_pick(rng, 3);
  int cuts = 1 + detail * shapes_pick(rng, 3);
  double r = size / 2 * shapes_uniform(rng, 0.3, 1);
  double h = size * shapes_uniform(rng, 0.4, 1);
  double thin = size * exp(shapes_uniform(rng, log(0.02), log(0.15)));
  double q = shapes_uniform(rng, 0.35, 0.8);
  double u, v;  // drawn in their own statements: C leaves the order of a call's arguments open
  int m;
  switch (shapes_pick(rng, 20)) {
    case 0:
    case 1:
      u = shapes_uniform(rng, 0.1, 1);
      v = shapes_uniform(rng, 0.15, 1);
      shapes_box(mesh, size, size * v, size * u, cuts);
      break;
    case 2:
      shapes_box(mesh, size, size * shapes_uniform(rng, 0.3, 1), thin, cuts);
      break;
    case 3:
      shapes_cylinder(mesh, r, h, n);
      break;
    case 4:
      shapes_cylinder(mesh, thin, size, n);
      break;
    case 5:
      u = shapes_uniform(rng, 0.3, 0.7);
      v = shapes_uniform(rng, 0.06, 0.25);
      shapes_capsule(mesh, size * v, size * u, n);
      break;
    case 6:
      shapes_cone(mesh, r, shapes_pick(rng, 2) ? 0 : r * q, h, n);
      break;
    case 7:
      shapes_torus(mesh, 0.38 * size, 0.38 * size * shapes_uniform(rng, 0.1, 0.45), n, n / 2);
      break;
    case 8:
      u = shapes_uniform(rng, 0.15, 0.5);
      v = shapes_uniform(rng, 0.15, 0.5);
      shapes_ellipsoid(mesh, size / 2, size * v, size * u, n);
      break;
    case 9:
      shapes_ring(mesh, size / 2, size / 2 * q, size * shapes_uniform(rng, 0.1, 0.9), n);
      break;
    case 10:
      shapes_l_bracket(mesh, size, size * q, fmax(thin, 0.05 * size),
                       size * shapes_uniform(rng, 0.1, 0.6));
      break;
    case 11:
      shapes_slot(mesh, size, size * q, size * shapes_uniform(rng, 0.2, 0.8), size * 0.5 * q,
                  size * 0.15);
      break;
    case 12:
      shapes_peg(mesh, size * shapes_uniform(rng, 0.06, 0.2), size, n);
      break;
    case 13:
      m = 6 + shapes_pick(rng, 10);
      u = shapes_uniform(rng, 0.05, 0.12);
      shapes_gear(mesh, size / 2, size * u, h / 2, m);
      break;
    case 14:
      shapes_slab(mesh, rng, size / 2, size * shapes_uniform(rng, 0.05, 0.6));
      break;
    case 15:
      shapes_bottle(mesh, size * shapes_uniform(rng, 0.15, 0.3), size, n);
      break;
    case 16:
      shapes_bowl(mesh, size / 2, size / 2 * q, fmax(thin, 0.02 * size), n);
      break;
    case 17:
      u = shapes_uniform(rng, 0.9, 1.3);
      v = shapes_uniform(rng, 0.5, 1);
      shapes_cup(mesh, size * 0.35, size * v, fmax(thin / 2, 0.015 * size), u, n);
      break;
    case 18:
      shapes_prism(mesh, r, h, 3 + shapes_pick(rng, 4));
      break;
    default:
      shapes_plate(mesh, size / 2, size * shapes_uniform(rng, 0.08, 0.2),
                   fmax(thin / 3, 0.01 * size), n);
      break;
  }
}
// The 'standard' family: one to eight parts that hang together, largest extent `extent`, centred.
SHAPES_DEF void shapes_random_solid(shapes_mesh *mesh, shapes_rng *rng, double extent) {
  int parts = 1 + (shapes_pick(rng, 3) ? shapes_pick(rng, 4) : shapes_pick(rng, 8));
  int detail = shapes_pick(rng, 3);
  int upright = shapes_pick(rng, 2);
  for (int i = 0; i < parts; i++) {
    size_t first = mesh->vertices;
    size_t before = first;
    double q[4];
    double anchor[3] = {0, 0, 0};
    double pull = shapes_uniform(rng, 0.3, 1);
    shapes_random_part(mesh, rng, i ? shapes_uniform(rng, 0.3, 0.9) : 1,
                       parts > 3 && detail == 2 ? 1 : detail);
    shapes_quaternion(rng, q);
    if (upright) {  // machined look: quarter turns only
      int axis = shapes_pick(rng, 3);
      for (int k = 0; k < 4; k++) q[k] = 0;
      q[axis] = q[3] = sqrt(0.5);
    }
    // Hang the part's centre on a vertex of what is there, drawn somewhat inwards so that they
    // overlap.
    if (i) memcpy(anchor, mesh->positions + 3 * (shapes_next(rng) % before), sizeof anchor);
    shapes_place(mesh, first, q, pull * anchor[0], pull * anchor[1], pull * anchor[2]);
  }
  shapes_fit(mesh, extent);
}
#define SHAPES_HOLLOWS 12
// The 'hollow' family: kind in [0, SHAPES_HOLLOWS), random proportions, largest extent `extent`,
// centred.
SHAPES_DEF void shapes_random_hollow(shapes_mesh *mesh, shapes_rng *rng, int kind, double extent) {
  double a = shapes_uniform(rng, 0.6, 1);
  double b = shapes_uniform(rng, 0.5, 1);
  double wall = shapes_uniform(rng, 0.015, 0.06);
  int n = 16 + 4 * shapes_pick(rng, 5);
  int m;
  int back;
  switch (kind) {
    case 0:
      shapes_cup(mesh, 0.45 * a, b, wall, shapes_uniform(rng, 0.9, 1.4), n);
      break;
    case 1:
      shapes_mug(mesh, 0.45 * a, b, fmax(wall, 0.025), n);
      break;
    case 2:
      m = 4 + shapes_pick(rng, 5);
      shapes_dish_rack(mesh, 1, a, 0.5 * b, shapes_uniform(rng, 0.008, 0.02), 0, m, 6);
      break;
    case 3:
      shapes_drawer(mesh, 1, a, 0.5 * b, wall);
      break;
    case 4:
      back = shapes_pick(rng, 2);
      m = 3 + shapes_pick(rng, 3);
      shapes_shelf(mesh, a, 0.5 * b, 1, wall, m, back);
      break;
    case 5:
      shapes_chair(mesh, 0.6 * a, 1, fmax(wall, 0.03));
      break;
    case 6:
      m = 8 + shapes_pick(rng, 9);
      shapes_basket(mesh, 0.45 * a, 0.7 * b, shapes_uniform(rng, 0.008, 0.02), m, n);
      break;
    case 7:
      shapes_ring(mesh, 0.4 * a, 0.4 * a - wall, b, n);
      break;
    case 8:
      shapes_knot(mesh, 0.5, shapes_uniform(rng, 0.03, 0.08), 72, 8);
      break;
    case 9:
      shapes_bowl(mesh, 0.5, 0.5 * b, wall, n);
      break;
    case 10:
      shapes_torus(mesh, 0.4, shapes_uniform(rng, 0.03, 0.1), n, 10);
      break;
    default:  // a table over a drawer: overlapping parts, internal surfaces
      shapes_drawer(mesh, 0.8 * a, 0.8 * b, 0.25, wall);
      shapes_box_at(mesh, 0, 0, 0.6, a, b, wall);
      for (int i = 0; i < 4; i++)
        shapes_box_at(mesh, (i % 2 - 0.5) * 0.7 * a, (i / 2 - 0.5) * 0.7 * b, 0.31, 0.04, 0.04,
                      0.62);
      break;
  }
  shapes_fit(mesh, extent);
}

#endif
