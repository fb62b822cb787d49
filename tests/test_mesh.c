// Tests of OBJ loading, surface sampling, FPS and patches with their covering balls.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "check.h"
#include "failing_heap.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

void test_mesh(void);

// ----------------------------------------------------------------------------------------- helpers

static uint64_t mesh_rng = 1;
static uint32_t mesh_random(void) {  // splitmix64
  uint64_t z = (mesh_rng += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (uint32_t)((z ^ (z >> 31)) >> 32);
}
static size_t mesh_below(size_t n) { return (size_t)mesh_random() % n; }
static double mesh_uniform(double low, double high) {
  return low + (high - low) * (double)mesh_random() / 4294967296.0;
}

static nsvcd_result parse(const char *text, nsvcd_mesh *mesh, size_t *line) {
  // An exact copy on the heap, without NUL: the sanitizer sees every read past the end.
  size_t size = strlen(text);
  char *copy = (char *)malloc(size + 1);
  char *start = copy + 1;
  memcpy(start, text, size);
  nsvcd_result result = nsvcd_obj_parse(start, size, NULL, mesh, line);
  free(copy);
  return result;
}

static double vector_length(const double *v) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// The corners of triangle t, its area vector and its area.
static double mesh_triangle(const nsvcd_mesh *mesh, size_t t, double corners[3][3],
                            double *vector) {
  const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
  const nsvcd__d3 v = nsvcd__area_vector(&triangle);
  const double out[3] = {v.x, v.y, v.z};
  memcpy(corners, &triangle, sizeof triangle);
  memcpy(vector, out, sizeof out);
  return nsvcd__triangle_area(&triangle);
}

// As vectors.
static nsvcd__f3 *mesh_f3s(float *numbers) { return (nsvcd__f3 *)(void *)numbers; }

static void mesh_area_vector(const nsvcd_mesh *mesh, double *sum) {
  sum[0] = sum[1] = sum[2] = 0;
  for (size_t t = 0; t < mesh->triangle_count; ++t) {
    double corners[3][3], v[3];
    mesh_triangle(mesh, t, corners, v);
    for (int k = 0; k < 3; ++k)
      sum[k] += v[k];
  }
}

static nsvcd_mesh mesh_new(size_t vertices, size_t triangles) {
  nsvcd_mesh mesh;
  mesh.positions = (float *)calloc(3 * vertices + 1, sizeof(float));
  mesh.indices = (uint32_t *)calloc(3 * triangles + 1, sizeof(uint32_t));
  mesh.vertex_count = vertices;
  mesh.triangle_count = triangles;
  return mesh;
}

// A closed surface of rings x segments quads around a torus (tube > 0), or a lumpy sphere (tube 0,
// poles are degenerate).
static nsvcd_mesh mesh_round(size_t rings, size_t segments, double radius, double tube) {
  nsvcd_mesh mesh = mesh_new(rings * segments, 2 * rings * segments);
  const double pi = 3.14159265358979323846;
  uint32_t *index = mesh.indices;
  for (size_t i = 0; i < rings; ++i) {
    for (size_t j = 0; j < segments; ++j) {
      double a =
          tube > 0 ? 2 * pi * (double)i / (double)rings : pi * (double)i / (double)(rings - 1);
      double b = 2 * pi * (double)j / (double)segments;
      double r =
          tube > 0 ? radius + tube * cos(a) : radius * sin(a) * (1 + 0.3 * cos(3 * b) * sin(a));
      if (tube <= 0 && (i == 0 || i == rings - 1))
        r = 0;  // exact poles close the surface
      float *p = mesh.positions + 3 * (i * segments + j);
      p[0] = (float)(r * cos(b));
      p[1] = (float)(r * sin(b));
      p[2] = (float)(tube > 0 ? tube * sin(a) : -radius * cos(a));
      if (tube <= 0 && i == rings - 1) {  // no quads beyond the last ring: points
        for (int k = 0; k < 6; ++k)
          *index++ = (uint32_t)(i * segments + j);
        continue;
      }
      uint32_t i1 = (uint32_t)((i + 1) % rings);
      uint32_t j1 = (uint32_t)((j + 1) % segments);
      uint32_t s = (uint32_t)segments;
      uint32_t v00 = (uint32_t)(i * segments + j);
      uint32_t v01 = (uint32_t)i * s + j1;
      uint32_t v10 = i1 * s + (uint32_t)j;
      uint32_t v11 = i1 * s + j1;
      *index++ = v00, *index++ = v01, *index++ = v11;
      *index++ = v00, *index++ = v11, *index++ = v10;
    }
  }
  return mesh;
}
static nsvcd_mesh mesh_box(double x, double y, double z) {
  static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  nsvcd_mesh mesh = mesh_new(8, 12);
  for (int i = 0; i < 8; ++i) {
    float *p = mesh.positions + 3 * i;
    p[0] = (float)(i & 1 ? x : -x);
    p[1] = (float)(i & 2 ? y : -y);
    p[2] = (float)(i & 4 ? z : -z);
  }
  memcpy(mesh.indices, faces, sizeof faces);
  return mesh;
}
// random triangles, some tiny, some slivers, some points
static nsvcd_mesh mesh_soup(size_t triangles, double size) {
  nsvcd_mesh mesh = mesh_new(3 * triangles, triangles);
  for (size_t i = 0; i < 3 * triangles; ++i) {
    double scale = i % 9 < 3 ? 1 : 0.05;
    for (size_t k = 0; k < 3; ++k) {
      double base = i % 3 ? (double)mesh.positions[3 * (i - i % 3) + k] : mesh_uniform(-size, size);
      mesh.positions[3 * i + k] = (float)(base + (i % 3 ? size * scale * mesh_uniform(-1, 1) : 0));
    }
    mesh.indices[i] = (uint32_t)i;
  }
  // no area
  for (size_t t = 0; t + 1 < triangles; t += 11)
    mesh.indices[3 * t + 1] = mesh.indices[3 * t];
  return mesh;
}
// slivers from one point: an open strip
static nsvcd_mesh mesh_fan(size_t triangles, double length, double width) {
  nsvcd_mesh mesh = mesh_new(triangles + 2, triangles);
  for (size_t i = 0; i <= triangles; ++i) {
    mesh.positions[3 * i] = (float)length;
    mesh.positions[3 * i + 1] = (float)(width * (double)i / (double)triangles);
  }
  for (size_t t = 0; t < triangles; ++t) {
    mesh.indices[3 * t] = (uint32_t)triangles + 1;
    mesh.indices[3 * t + 1] = (uint32_t)t;
    mesh.indices[3 * t + 2] = (uint32_t)t + 1;
  }
  return mesh;
}
static void mesh_scale(nsvcd_mesh *mesh, float s) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; ++i)
    mesh->positions[i] *= s;
}
static void mesh_move(nsvcd_mesh *mesh, float d) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; ++i)
    mesh->positions[i] += d;
}
enum { MESH_KINDS = 9 };
static nsvcd_mesh mesh_kind(int kind) {
  nsvcd_mesh mesh;
  switch (kind) {
    case 0:
      return mesh_box(0.1, 0.08, 0.06);
    case 1:
      return mesh_box(0.2, 0.2, 0.001);  // a thin plate
    case 2:
      return mesh_round(40, 60, 0.1, 0.03);  // a torus
    case 3:
      return mesh_round(33, 48, 0.12, 0);  // a lumpy sphere
    case 4:
      return mesh_soup(300, 0.15);
    case 5:
      return mesh_fan(200, 1, 0.05);
    case 6:
      return mesh_box(1, 1e-4, 1e-4);  // a needle
    case 7:
      mesh = mesh_round(20, 30, 0.1, 0.04);
      mesh_move(&mesh, 500);
      return mesh;  // far from the origin
    default:
      mesh = mesh_round(90, 120, 0.1, 0.05);
      mesh_scale(&mesh, 1e-3f);
      return mesh;
  }
}
static const int mesh_kind_closed[MESH_KINDS] = {1, 1, 1, 1, 0, 0, 1, 1, 1};

// --------------------------------------------------------------------------------------------- OBJ

#define TETRAHEDRON "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"

static void mesh_result_strings(void) {
  for (int i = 0; i <= NSVCD_ERROR_CANCELLED; ++i) {
    CHECK(strlen(nsvcd_result_string((nsvcd_result)i)) > 0);
    for (int j = 0; j < i; ++j) {
      CHECK(strcmp(nsvcd_result_string((nsvcd_result)i), nsvcd_result_string((nsvcd_result)j)) !=
            0);
    }
  }
  CHECK(strcmp(nsvcd_result_string((nsvcd_result)(NSVCD_ERROR_CANCELLED + 1)), "unknown result") ==
        0);
}

static void mesh_obj_accepted(void) {
  static const struct {
    const char *text;
    size_t vertices, triangles;
    uint32_t last[3];  // triangle
  } cases[] = {
      {TETRAHEDRON "f 1 2 3\n", 4, 1, {0, 1, 2}},
      {TETRAHEDRON "f 1 2 3", 4, 1, {0, 1, 2}},                           // no final newline
      {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", 3, 1, {0, 1, 2}},  // CRLF
      {"v\t0\t0 \t0\n\tv 1 0 0\nv 0 1 0  \nf\t1\t2\t3\t\n", 3, 1, {0, 1, 2}},
      {TETRAHEDRON "f 1/1 2/2 3/3\nf 1//1 3//2 4//3\nf 1/1/1 4/2/-2 2/-3/3\n", 4, 3, {0, 3, 1}},
      {TETRAHEDRON "f -4 -3 -2\nf -1 -2 -3\n", 4, 2, {3, 2, 1}},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n", 4, 2, {3, 2, 1}},
      // refers to later vertices
      {"f 1 2 3\n" TETRAHEDRON, 4, 1, {0, 1, 2}},
      {"f 1 2 4 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", 4, 2, {1, 3, 2}},  // so does a polygon
      // w, colours
      {"v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0.1 0.2 0.3\nf 1 2 3", 3, 1, {0, 1, 2}},
      // continued lines
      {"v 0 0 \\\n0\nv 1 0 0\nv 0 \\\r\n 1 0\nf 1 2\\\n 3", 3, 1, {0, 1, 2}},
      {"# comment \\\nv 0 0 0 # one\nv 1 0 0 #\nv 0 1 0\nf 1 2 3 # four", 3, 1, {0, 1, 2}},
      {"\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", 3, 1, {0, 1, 2}},  // byte order mark
      {"mtllib a.mtl\no x\ng y z\ns off\nusemtl m\nvt 0 0\nvn 0 0 1\nvp 1\np 1\nl 1 2\ncurv2 "
       "\xff\n" TETRAHEDRON "f 1 2 3\n",
       0,
       0,
       {0, 0, 0}},
      {TETRAHEDRON "f 1 1 1\nf 1 2 2\n", 4, 2, {0, 1, 1}},  // no area
      {"v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3 4\n", 4, 2, {1, 2, 3}},
      {"\n\n   \nv +1. -.5 1E+2\nv 1e-3 -0 0e999999999999999999999\nv 1e-999999 0.000 007\nf 1 2 3",
       3,
       1,
       {0, 1, 2}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    nsvcd_mesh mesh;
    size_t line = 99;
    nsvcd_result result = parse(cases[i].text, &mesh, &line);
    if (cases[i].vertices == 0) {  // "curv2": a keyword with a digit is not a keyword
      CHECK_EQ(result, NSVCD_ERROR_SYNTAX);
      CHECK_EQ(line, 11);
      continue;
    }
    if (result != NSVCD_OK)
      printf("case %d, line %d: %s\n", (int)i, (int)line, nsvcd_result_string(result));
    CHECK_EQ(result, NSVCD_OK);
    if (result != NSVCD_OK)
      continue;
    CHECK_EQ(line, 0);
    CHECK_EQ(mesh.vertex_count, cases[i].vertices);
    CHECK_EQ(mesh.triangle_count, cases[i].triangles);
    const uint32_t *last = mesh.indices + 3 * (mesh.triangle_count - 1);
    for (int k = 0; k < 3; ++k)
      CHECK_EQ(last[k], cases[i].last[k]);
    CHECK_EQ(nsvcd__mesh_check(&mesh), NSVCD_OK);
    nsvcd_mesh_free(&mesh, NULL);
    CHECK(mesh.positions == NULL && mesh.indices == NULL && mesh.vertex_count == 0 &&
          mesh.triangle_count == 0);
  }
}

static void mesh_obj_refused(void) {
  static const struct {
    const char *text;
    nsvcd_result result;
    size_t line;
  } cases[] = {
      {"", NSVCD_ERROR_EMPTY, 0},
      {"# nothing\n", NSVCD_ERROR_EMPTY, 0},
      {TETRAHEDRON, NSVCD_ERROR_EMPTY, 0},
      {"f 1 2 3\n", NSVCD_ERROR_INDEX, 1},
      {TETRAHEDRON "f 0 1 2\n", NSVCD_ERROR_INDEX, 5},
      {TETRAHEDRON "f 1 2 -0\n", NSVCD_ERROR_INDEX, 5},
      {TETRAHEDRON "f 1 2 3\n\n# x\nf 1 2 5\n", NSVCD_ERROR_INDEX, 8},
      {TETRAHEDRON "f 1 2 -5\n", NSVCD_ERROR_INDEX, 5},
      // negative: only what came before
      {"v 0 0 0\nv 0 0 1\nf -1 -2 -3\nv 1 0 0\n", NSVCD_ERROR_INDEX, 3},
      {TETRAHEDRON "f 1 2 4294967297\n", NSVCD_ERROR_INDEX, 5},  // 1 modulo 2^32
      {TETRAHEDRON "f 1 2 18446744073709551617\n", NSVCD_ERROR_INDEX, 5},
      {TETRAHEDRON "f 1 2 -99999999999999999999999999\n", NSVCD_ERROR_INDEX, 5},
      {TETRAHEDRON "f\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1 2", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1 2 x\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1 2 3.0\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1/1/1/1 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1/a 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f /1 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f - 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f1 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {"v\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2 3 4 5 6 7 8 9\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2 3 red\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"\r\n\r\nv 1,5 2 3\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 3},  // decimal comma
      {"v 1 2 3e\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2 .\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2 1.2.3\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2 0x10\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 2 --1\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},
      {"v 1 0 1.#INF\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},  // as old Microsoft libraries print it
      {"v nan 0 0\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 0\nv 0 -NaN 0\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 2},
      {"v 0 0 inf\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 -Infinity\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 0 0.5 1e39 0\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},  // a colour
      {"v 0 0 1e39\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 1e999999999999999999999\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 -1000001\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},  // beyond NSVCD_MAX_COORDINATE
      {"v 0 0 \\\n\\\n1e7\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 3},
      {"v 0 0 0\n\x01\x02 1 2 3\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 2},
      {"\x89PNG\r\n\x1a\n", NSVCD_ERROR_SYNTAX, 1},
      // lines ended by CR alone are one vertex line: no face
      {"v 0 0 0\rv 0 0 1\rf 1 2 1\r", NSVCD_ERROR_EMPTY, 0},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    for (int fail_at = -1; fail_at < 4; ++fail_at) {
      failing_heap heap = {0, 0, 0};
      heap.fail_at = fail_at;
      nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
      allocator.user = &heap;
      nsvcd_mesh mesh, before;
      size_t line = 99;
      memset(&mesh, 0x5a, sizeof mesh);
      before = mesh;
      nsvcd_result result =
          nsvcd_obj_parse(cases[i].text, strlen(cases[i].text), &allocator, &mesh, &line);
      int out_of_memory = result == NSVCD_ERROR_MEMORY && fail_at >= 0 && fail_at < heap.calls;
      if (!out_of_memory) {
        if (result != cases[i].result || line != cases[i].line)
          printf("case %d: %s", (int)i, cases[i].text);
        CHECK_EQ(result, cases[i].result);
        CHECK_EQ(line, cases[i].line);
      }
      CHECK_EQ(heap.live, 0);
      CHECK(memcmp(&mesh, &before, sizeof mesh) == 0);
      CHECK(nsvcd_obj_parse(cases[i].text, strlen(cases[i].text), NULL, &mesh, NULL) ==
            cases[i].result);
    }
  }
  nsvcd_mesh mesh;
  CHECK_EQ(nsvcd_obj_parse(NULL, 0, NULL, &mesh, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_obj_parse("f", 1, NULL, NULL, NULL), NSVCD_ERROR_ARGUMENT);
  // cut short: f 1 1
  CHECK_EQ(nsvcd_obj_parse("v 0 0 0\nf 1 1 1", 14, NULL, &mesh, NULL), NSVCD_ERROR_SYNTAX);
  // a NUL
  CHECK_EQ(nsvcd_obj_parse("v 0 0 0\nv 0 0 \0000\nf 1 1 1", 25, NULL, &mesh, NULL),
           NSVCD_ERROR_SYNTAX);
}

static void mesh_obj_allocation_fails(void) {
  static const char text[] = TETRAHEDRON "f 1 2 3 4\n";
  int failures = 0;
  for (int fail_at = 0;; ++fail_at) {
    failing_heap heap = {0, 0, 0};
    heap.fail_at = fail_at;
    nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
    allocator.user = &heap;
    nsvcd_mesh mesh;
    size_t line = 99;
    nsvcd_result result = nsvcd_obj_parse(text, sizeof text - 1, &allocator, &mesh, &line);
    CHECK_EQ(line, 0);
    if (result == NSVCD_OK) {
      CHECK_EQ(heap.live, 2);
      nsvcd_mesh_free(&mesh, &allocator);
      CHECK_EQ(heap.live, 0);
      break;
    }
    CHECK_EQ(result, NSVCD_ERROR_MEMORY);
    CHECK_EQ(heap.live, 0);
    failures++;
  }
  CHECK_EQ(failures, 3);
}

// Counters close to their caps: nobody has 16 GB of text for a test.
static void mesh_obj_counts_are_capped(void) {
  nsvcd__obj obj;
  nsvcd__obj_begin(&obj, "v\nv\n", 4);
  obj.vertices = 0x7ffffffe;
  CHECK_EQ(nsvcd__obj_count(&obj), NSVCD_ERROR_TOO_LARGE);
  CHECK_EQ(obj.line, 2);
  nsvcd__obj_begin(&obj, "f 1 2 3\nf 1 2 3 4\n", 18);
  obj.triangles = 0x7ffffffc;
  CHECK_EQ(nsvcd__obj_count(&obj), NSVCD_OK);
  nsvcd__obj_begin(&obj, "f 1 2 3\nf 1 2 3 4\n", 18);
  obj.triangles = 0x7ffffffd;
  CHECK_EQ(nsvcd__obj_count(&obj), NSVCD_ERROR_TOO_LARGE);
  CHECK_EQ(obj.line, 2);
  CHECK(nsvcd__alloc_array(NULL, SIZE_MAX / 2, 3) == NULL);
}

static void mesh_obj_numbers(void) {
  static const char *const formats[] = {"%.9g", "%.6f", "%.8e", "%.17g", "%.3e", "%.25f"};
  int wrong = 0;
  int tried = 0;
  mesh_rng = 7;
  for (int i = 0; i < 60000; ++i) {
    char text[512];
    double x = mesh_uniform(-1, 1) * pow(10, mesh_uniform(-30, 5.9));
    snprintf(text, sizeof text, formats[i % 6], i % 12 < 6 ? x : (double)(float)x);
    nsvcd__obj obj;
    double value = 0;
    nsvcd__obj_begin(&obj, text, strlen(text));
    CHECK_EQ(nsvcd__obj_number(&obj, &value), NSVCD_OK);
    wrong += (float)value < strtof(text, NULL) || (float)value > strtof(text, NULL);
    tried++;
  }
  printf("%d numbers, %d not rounded as strtof does\n", tried, wrong);
  CHECK_EQ(wrong, 0);
  static const char *const exact[] = {"16777217",
                                      "0.1",
                                      "1e-45",
                                      "1.17549435e-38",
                                      "999999.96875",
                                      "123456789012345678901234567890e-27",
                                      "0.000000000000000000000000000012345e27"};
  for (size_t i = 0; i < sizeof exact / sizeof exact[0]; ++i) {
    nsvcd__obj obj;
    double value = 0;
    nsvcd__obj_begin(&obj, exact[i], strlen(exact[i]));
    CHECK_EQ(nsvcd__obj_number(&obj, &value), NSVCD_OK);
    CHECK_EQ((float)value, strtof(exact[i], NULL));
  }
}

static void mesh_obj_in_any_locale(void) {
  static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"};
  for (size_t i = 0; i < sizeof names / sizeof names[0] && !setlocale(LC_ALL, names[i]); ++i)
    continue;
  nsvcd_mesh mesh;
  nsvcd_result result = parse("v 1.5 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n", &mesh, NULL);
  setlocale(LC_ALL, "C");
  CHECK_EQ(result, NSVCD_OK);
  if (result != NSVCD_OK)
    return;
  CHECK_EQ(mesh.positions[0], 1.5);
  nsvcd_mesh_free(&mesh, NULL);
}

// Lines of a megabyte and more, of every kind. Anything quadratic would take minutes here.
static void mesh_obj_long_lines(void) {
  enum { CORNERS = 300000 };
  size_t capacity = 16000000;
  size_t used = 0;
  char *text = (char *)malloc(capacity);
  used += (size_t)sprintf(text + used, "#");
  memset(text + used, 'x', 2000000);
  used += 2000000;
  used += (size_t)sprintf(text + used, "\ng");
  for (int i = 0; i < 500000; ++i) {
    text[used++] = ' ';
    text[used++] = 'a';
  }
  for (int i = 0; i < 500000; ++i) {
    text[used++] = '\\';
    text[used++] = '\n';
  }
  used += (size_t)sprintf(text + used, "\nv 0.");
  memset(text + used, '0', 1000000);
  used += 1000000;
  used += (size_t)sprintf(text + used, "1e1000001");
  memset(text + used, ' ', 1000000);
  used += 1000000;
  used += (size_t)sprintf(text + used, "0 0\nv 0 0 0\nv 0 1 0\nf");
  for (int i = 0; i < CORNERS; ++i)
    used += (size_t)sprintf(text + used, " %d/1/1", i % 3 + 1);
  nsvcd_mesh mesh;
  size_t line = 0;
  nsvcd_result result = nsvcd_obj_parse(text, used, NULL, &mesh, &line);
  if (result != NSVCD_OK)
    printf("line %d: %s\n", (int)line, nsvcd_result_string(result));
  CHECK_EQ(result, NSVCD_OK);
  if (result == NSVCD_OK) {
    CHECK_EQ(mesh.triangle_count, CORNERS - 2);
    CHECK_EQ(mesh.positions[0], 1);
    nsvcd_mesh_free(&mesh, NULL);
  }
  used += (size_t)sprintf(text + used, "\nf 1 2 3\nf 1 2 9\n");
  CHECK_EQ(nsvcd_obj_parse(text, used, NULL, &mesh, &line), NSVCD_ERROR_INDEX);
  CHECK_EQ(line, 500000 + 8);
  // A zigzag of 100,000 corners: concave, and more than can be clipped in the time a parser may
  // take.
  used = 0;
  for (int i = 0; i < 100000; ++i)
    used += (size_t)sprintf(text + used, "v %d %d 0\n", i < 50000 ? i : 100000 - i,
                            i % 2 + (i < 50000 ? 0 : 5));
  used += (size_t)sprintf(text + used, "f");
  for (int i = 0; i < 100000; ++i)
    used += (size_t)sprintf(text + used, " %d", i + 1);
  CHECK_EQ(nsvcd_obj_parse(text, used, NULL, &mesh, &line), NSVCD_ERROR_TOO_LARGE);
  CHECK_EQ(line, 100001);
  free(text);
}

static void mesh_obj_files(void) {
  nsvcd_mesh mesh;
  size_t line = 99;
  CHECK_EQ(nsvcd_obj_load("/nowhere/at all.obj", NULL, &mesh, &line), NSVCD_ERROR_IO);
  CHECK_EQ(line, 0);
  CHECK_EQ(nsvcd_obj_load(NULL, NULL, &mesh, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK(nsvcd_obj_load(".", NULL, &mesh, &line) != NSVCD_OK);  // a directory
  char path[L_tmpnam + 1] = "nsvcd_test_mesh.obj";
  FILE *file = fopen(path, "wb");
  CHECK(file != NULL);
  if (!file)
    return;
  for (int i = 0; i < 40000; ++i)
    fprintf(file, "v %d 0.5 0\n", i);  // larger than the first read
  fprintf(file, "f 1 2 40000\nf 1 2 40001\n");
  fclose(file);
  for (int fail_at = -1; fail_at < 12; ++fail_at) {
    failing_heap heap = {0, 0, 0};
    heap.fail_at = fail_at;
    nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
    allocator.user = &heap;
    nsvcd_result result = nsvcd_obj_load(path, &allocator, &mesh, &line);
    CHECK_EQ(result, fail_at >= 0 && fail_at < heap.calls ? NSVCD_ERROR_MEMORY : NSVCD_ERROR_INDEX);
    CHECK_EQ(line, result == NSVCD_ERROR_INDEX ? 40002 : 0);
    CHECK_EQ(heap.live, 0);
  }
  file = fopen(path, "wb");
  fprintf(file, "v 0 0 0\nf 1 1 1");
  fclose(file);
  for (int i = 0; i < 2000; ++i) {  // more often than files can be open at once
    CHECK_EQ(nsvcd_obj_load(path, NULL, &mesh, NULL), NSVCD_OK);
    nsvcd_mesh_free(&mesh, NULL);
  }
  remove(path);
}

// Mutated files: whatever is accepted must be sound, whatever is refused must leave nothing behind.
static void mesh_obj_fuzz(void) {
  static const char seed[] =
      "# seed\nv 0 0 0\nv 1.5e0 0 0 1\nv 1 1 0 .1 .2 .3\r\nv 0 1 -0\nv 0.5 0.5 1\n"
      "vt 0 0\nvn 0 0 1\no a\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf 1//1 2//1 \\\n 5\nf -1 -2 -3 2\nf 1 2 3 "
      "5 4";
  static const char alphabet[] = "0123456789-+.eE/\\ \t\r\n#vfnai\0\xff";
  enum { ROUNDS = 40000 };
  int accepted = 0;
  mesh_rng = 3;
  for (int round = 0; round < ROUNDS; ++round) {
    char text[400];
    size_t size = sizeof seed - 1;
    memcpy(text, seed, size);
    for (size_t i = mesh_below(6); i > 0; --i) {
      size_t at = mesh_below(size);
      size_t length = 1 + mesh_below(8);
      switch (mesh_below(4)) {
        case 0:
          text[at] = alphabet[mesh_below(sizeof alphabet)];
          break;
        case 1:
          text[at] = (char)mesh_below(256);
          break;
        case 2:  // cut out
          if (at + length > size || size - length < 1)
            break;
          memmove(text + at, text + at + length, size - at - length);
          size -= length;
          break;
        default:  // double
          if (at + length > size || size + length > sizeof text)
            break;
          memmove(text + at + length, text + at, size - at);
          size += length;
      }
    }
    char *exact = (char *)malloc(size);
    memcpy(exact, text, size);
    failing_heap heap = {0, 0, -1};
    nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
    allocator.user = &heap;
    nsvcd_mesh mesh;
    size_t line = 999;
    nsvcd_result result = nsvcd_obj_parse(exact, size, &allocator, &mesh, &line);
    size_t lines = 1;
    for (size_t i = 0; i < size; ++i)
      lines += exact[i] == '\n';
    CHECK_LE(line, lines);
    if (result == NSVCD_OK) {
      CHECK_EQ(nsvcd__mesh_check(&mesh), NSVCD_OK);
      CHECK_EQ(heap.live, 2);
      nsvcd_mesh_free(&mesh, &allocator);
      accepted++;
    }
    CHECK_EQ(heap.live, 0);
    free(exact);
  }
  printf("%d mutated files, %d accepted\n", ROUNDS, accepted);
  CHECK(accepted > ROUNDS / 20 && accepted < ROUNDS);
}

static void mesh_is_checked(void) {
  nsvcd_mesh mesh = mesh_box(1, 1, 1);
  nsvcd_mesh bad;
  CHECK_EQ(nsvcd__mesh_check(&mesh), NSVCD_OK);
  CHECK_EQ(nsvcd__mesh_check(NULL), NSVCD_ERROR_ARGUMENT);
  bad = mesh;
  bad.triangle_count = 0;
  CHECK_EQ(nsvcd__mesh_check(&bad), NSVCD_ERROR_EMPTY);
  bad = mesh;
  bad.positions = NULL;
  CHECK_EQ(nsvcd__mesh_check(&bad), NSVCD_ERROR_ARGUMENT);
  bad = mesh;
  bad.vertex_count = 7;
  CHECK_EQ(nsvcd__mesh_check(&bad), NSVCD_ERROR_INDEX);
  bad = mesh;
  bad.vertex_count = 0x80000000u;
  CHECK_EQ(nsvcd__mesh_check(&bad), NSVCD_ERROR_TOO_LARGE);
  bad = mesh;
  bad.triangle_count = 0x80000000u;
  CHECK_EQ(nsvcd__mesh_check(&bad), NSVCD_ERROR_TOO_LARGE);
  static const float numbers[] = {HUGE_VALF, -HUGE_VALF, 1.01e6f, -2e6f};
  for (size_t i = 0; i < 5; ++i) {
    mesh.positions[23] = i < 4 ? numbers[i] : sqrtf(-1);
    CHECK_EQ(nsvcd__mesh_check(&mesh), NSVCD_ERROR_NUMBER);
  }
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_mesh_free(&mesh, NULL);  // twice is harmless
  nsvcd_mesh_free(NULL, NULL);
}

// ---------------------------------------------------------------------------------------- polygons

enum { POLYGON_MAX = 400 };

// Triangulates a polygon given in the plane after placing it in space; returns the sum of the
// triangles' areas over the polygon's (1 if they cover it without overlap), and checks that the
// vector areas agree.
static double polygon_cover(const double (*xy)[2], uint32_t count) {
  static nsvcd__corner corners[POLYGON_MAX];
  static float positions[3 * POLYGON_MAX];
  static uint32_t triangles[3 * POLYGON_MAX];
  nsvcd_mesh mesh = {positions, triangles, 0, 0};
  float q[4];
  float m[9];
  float norm = 0;
  for (int k = 0; k < 4; ++k) {
    q[k] = (float)mesh_uniform(-1, 1);
    norm += q[k] * q[k];
  }
  for (int k = 0; k < 4; ++k)
    q[k] /= sqrtf(norm);
  nsvcd__quat_to_matrix(q, m);
  double area = 0;
  double covered = 0;
  double vector[3];
  double normal[3];
  for (uint32_t i = 0; i < count; ++i) {
    const double *a = xy[i];
    const double *b = xy[(i + 1) % count];
    float flat[3] = {(float)a[0], (float)a[1], 0.3f};
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    nsvcd__mul33_vec(m, flat, positions + 3 * i);
    corners[i].vertex = i;
  }
  CHECK_EQ(nsvcd__polygon_triangulate(corners, count, positions, triangles), NSVCD_OK);
  mesh.vertex_count = count;
  mesh.triangle_count = count - 2;
  CHECK_EQ(nsvcd__mesh_check(&mesh), NSVCD_OK);
  for (size_t t = 0; t < mesh.triangle_count; ++t) {
    double corner[3][3], v[3];
    covered += mesh_triangle(&mesh, t, corner, v);
  }
  mesh_area_vector(&mesh, vector);
  for (int k = 0; k < 3; ++k)
    normal[k] = area * (double)m[3 * k + 2] - vector[k];
  CHECK_LE(vector_length(normal), 1e-5 * (fabs(area) + covered) + 1e-12);
  return covered / fabs(area);
}

static int segments_cross(const double *a, const double *b, const double *c, const double *d) {
  double u = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  double v = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
  double w = (d[0] - c[0]) * (a[1] - c[1]) - (d[1] - c[1]) * (a[0] - c[0]);
  double x = (d[0] - c[0]) * (b[1] - c[1]) - (d[1] - c[1]) * (b[0] - c[0]);
  return (u > 0) != (v > 0) && (w > 0) != (x > 0);
}

// Random simple polygons: random points, crossings undone by reversing the stretch between them
// (2-opt).
static void mesh_polygons_simple(void) {
  static double xy[POLYGON_MAX][2];
  int count = 0;
  int wrong = 0;
  mesh_rng = 11;
  for (int round = 0; round < 1000; ++round) {
    uint32_t n = (uint32_t)(4 + mesh_below(round % 50 == 0 ? 60 : 16));
    for (uint32_t i = 0; i < n; ++i) {
      xy[i][0] = mesh_uniform(-1, 1);
      xy[i][1] = mesh_uniform(-1, 1);
    }
    for (int crossed = 1; crossed;) {
      crossed = 0;
      for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = i + 2; j < n; ++j) {
          if ((j + 1) % n == i || !segments_cross(xy[i], xy[i + 1], xy[j], xy[(j + 1) % n]))
            continue;
          for (uint32_t a = i + 1, b = j; a < b; ++a, --b) {
            for (int k = 0; k < 2; ++k) {
              double swap = xy[a][k];
              xy[a][k] = xy[b][k];
              xy[b][k] = swap;
            }
          }
          crossed = 1;
        }
      }
    }
    wrong += fabs(polygon_cover((const double(*)[2])xy, n) - 1) > 1e-3;
    count++;
  }
  printf("%d simple polygons, %d not covered exactly\n", count, wrong);
  CHECK_EQ(wrong, 0);
}

static void mesh_polygons_special(void) {
  static double xy[POLYGON_MAX][2];
  const double pi = 3.14159265358979323846;
  mesh_rng = 12;
  for (int round = 0; round < 200; ++round) {  // stars, both ways round
    uint32_t n = (uint32_t)(5 + mesh_below(200));
    for (uint32_t i = 0; i < n; ++i) {
      double angle = (round % 2 ? -2 : 2) * pi * i / n;
      double r = mesh_uniform(0.2, 1);
      xy[i][0] = r * cos(angle);
      xy[i][1] = r * sin(angle);
    }
    CHECK_NEAR(polygon_cover((const double(*)[2])xy, n), 1, 1e-4);
  }
  for (uint32_t i = 0; i < 200; ++i) {  // a spiral: out along one side, back along the other
    double angle = 0.1 * (i < 100 ? i : 199 - i);
    double r = 0.1 + 0.05 * angle + (i < 100 ? 0 : 0.02);
    xy[i][0] = r * cos(angle);
    xy[i][1] = r * sin(angle);
  }
  CHECK_NEAR(polygon_cover((const double(*)[2])xy, 200), 1, 1e-4);
  for (uint32_t n = 4; n < 60; n += 7) {  // a comb on a grid: many corners in line
    for (uint32_t i = 0; i < n; ++i) {
      xy[i][0] = i / 2;
      xy[i][1] = (i / 2 + i) % 2 ? 1 : 0.5;
    }
    xy[n][0] = n;
    xy[n][1] = 0;
    for (uint32_t i = 0; i <= n; ++i) {
      xy[n + 1 + i][0] = n - i;
      xy[n + 1 + i][1] = -1;
    }
    CHECK_NEAR(polygon_cover((const double(*)[2])xy, 2 * n + 2), 1, 1e-4);
  }
  // a ring cut open by a bridge: its four corners coincide in pairs
  for (int round = 0; round < 100; ++round) {
    uint32_t n = (uint32_t)(3 + mesh_below(20));
    double turn = mesh_uniform(0, 6);
    for (uint32_t i = 0; i <= n; ++i) {
      double a = turn + 2 * pi * (i % n) / n;
      double r = 1 - 0.2 * (double)(i % n % 2);
      double inner = r * 0.3;
      xy[i][0] = r * cos(a);
      xy[i][1] = r * sin(a);
      xy[2 * n + 1 - i][0] = inner * cos(a);
      xy[2 * n + 1 - i][1] = inner * sin(a);
    }
    CHECK_NEAR(polygon_cover((const double(*)[2])xy, 2 * n + 2), 1, 1e-4);
  }
  // Not simple: only the vector area is promised.
  for (int round = 0; round < 300; ++round) {
    uint32_t n = (uint32_t)(4 + mesh_below(30));
    for (uint32_t i = 0; i < n; ++i) {
      xy[i][0] = (double)mesh_below(4);
      xy[i][1] = (double)mesh_below(4);
    }
    polygon_cover((const double(*)[2])xy, n);
  }
}

// ---------------------------------------------------------------------------------- surface points

static void mesh_samples_are_uniform(void) {
  enum { S = 8192 };
  static float points[3 * S], normals[3 * S];
  nsvcd_mesh mesh = mesh_box(0.1, 0.2, 0.3);
  // One triangle more, without area, first of all: never chosen.
  mesh.indices = (uint32_t *)realloc(mesh.indices, 39 * sizeof(uint32_t));
  memmove(mesh.indices + 3, mesh.indices, 36 * sizeof(uint32_t));
  mesh.indices[0] = mesh.indices[1] = 0;
  mesh.indices[2] = 7;
  mesh.triangle_count = 13;
  nsvcd__sample_surface(&mesh, S, mesh_f3s(points), mesh_f3s(normals));
  double face[6] = {0, 0, 0, 0, 0, 0};
  double mean[6][2] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
  static const double half[3] = {0.1, 0.2, 0.3};
  for (size_t s = 0; s < S; ++s) {
    const float *p = points + 3 * s;
    const float *n = normals + 3 * s;
    CHECK_NEAR(nsvcd__length3(n), 1, 1e-6);
    size_t axis = fabsf(n[0]) > 0.9f ? 0 : fabsf(n[1]) > 0.9f ? 1 : 2;
    size_t side = n[axis] > 0;
    CHECK_NEAR(p[axis], side ? half[axis] : -half[axis], 1e-7);
    face[2 * axis + side]++;
    for (size_t k = 0; k < 2; ++k)
      mean[2 * axis + side][k] += (double)p[(axis + 1 + k) % 3] / half[(axis + 1 + k) % 3];
  }
  double total = 0.02 + 0.06 + 0.03;  // of the three products of half extents
  for (size_t f = 0; f < 6; ++f) {
    double share = (f < 2 ? 0.06 : f < 4 ? 0.03 : 0.02) / (2 * total);
    CHECK_NEAR(face[f], (double)S * share, 1.01);  // stratified: to one sample at each end
    for (size_t k = 0; k < 2; ++k)
      CHECK_NEAR(mean[f][k] / face[f], 0, 0.02);
  }
  nsvcd_mesh_free(&mesh, NULL);

  mesh = mesh_round(30, 40, 0.1, 0.04);  // every triangle gets its share, to one sample
  nsvcd__sample_surface(&mesh, S, mesh_f3s(points), mesh_f3s(normals));
  double z2 = 0;
  double exact = 0;
  for (size_t s = 0; s < S; ++s)
    z2 += (double)points[3 * s + 2] * (double)points[3 * s + 2] / (double)S;
  // integral of z^2 over a triangle: mean over the edges' middles
  for (size_t t = 0; t < mesh.triangle_count; ++t) {
    double c[3][3], v[3];
    double area = mesh_triangle(&mesh, t, c, v) / nsvcd__mesh_area(&mesh);
    for (int i = 0; i < 3; ++i)
      exact += area / 3 * pow(0.5 * (c[i][2] + c[(i + 1) % 3][2]), 2);
  }
  CHECK_NEAR(z2 / exact, 1, 2e-3);
  nsvcd_mesh_free(&mesh, NULL);
}

static void mesh_samples_scale(void) {
  enum { S = 1000 };
  static float a[3 * S], b[3 * S], normals[3 * S], scaled_normals[3 * S];
  static const float scales[] = {0.0009765625f, 1048576.0f, 1e-3f, 1e3f, 1e-9f, 3e-15f};
  for (size_t i = 0; i < sizeof scales / sizeof scales[0]; ++i) {
    nsvcd_mesh mesh = mesh_round(25, 31, 0.1, 0.04);
    nsvcd__sample_surface(&mesh, S, mesh_f3s(a), mesh_f3s(normals));
    mesh_scale(&mesh, scales[i]);
    nsvcd__sample_surface(&mesh, S, mesh_f3s(b), mesh_f3s(scaled_normals));
    double worst = 0;
    double turned = 0;
    for (size_t k = 0; k < 3 * S; ++k) {
      worst = fmax(worst, fabs((double)b[k] / (double)scales[i] - (double)a[k]));
      turned = fmax(turned, fabs((double)normals[k] - (double)scaled_normals[k]));
    }
    CHECK_LE(worst, i < 2 ? 0 : 1e-7);  // a power of two changes nothing at all
    CHECK_LE(turned, i < 2 ? 0 : 1e-5);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static void mesh_samples_lie_mid_stratum(void) {
  float points[12], normals[12];
  nsvcd_mesh mesh = mesh_fan(2, 1, 1);  // triangles of equal area,
  mesh.positions[4] = 0.2f;             // now a fifth and four fifths of the whole
  nsvcd__sample_surface(&mesh, 4, mesh_f3s(points), mesh_f3s(normals));
  // at 1/8, 3/8, 5/8, 7/8
  for (int i = 0; i < 4; ++i)
    CHECK_EQ(points[3 * i + 1] < 0.2f * points[3 * i], i == 0);
  nsvcd_mesh_free(&mesh, NULL);
}

// ----------------------------------------------------------------------------------------- patches

// Samples without a mesh: (n, 3) random points, some of them equal.
static nsvcd__patches patches_of_points(size_t centres, size_t samples) {
  nsvcd__patches p;
  CHECK(nsvcd__patches_alloc(&p, centres, samples, NULL));
  for (size_t s = 0; s < samples; ++s) {
    p.drawn[s].x = (float)mesh_below(40);
    p.drawn[s].y = (float)mesh_below(40);
    p.drawn[s].z = (float)mesh_below(4);
  }
  return p;
}

// Each centre is, at its turn, a sample farthest from those before it; each sample goes to a
// nearest centre.
static void mesh_farthest_points_are_farthest(void) {
  mesh_rng = 51;
  for (int round = 0; round < 20; ++round) {
    nsvcd__patches p = patches_of_points(60, 1500);
    nsvcd__farthest_points(&p);
    CHECK_EQ(p.count, 60);
    for (uint32_t i = 1; i <= p.count; ++i) {
      float farthest = 0;
      float centre = HUGE_VALF;
      for (uint32_t j = 0; i < p.count && j < i; ++j) {
        centre = fminf(centre, nsvcd__centre_distance(&p, j, p.centres[i]));
      }
      for (size_t s = 0; s < p.sample_count; ++s) {
        float nearest = HUGE_VALF;
        for (uint32_t j = 0; j < i; ++j)
          nearest = fminf(nearest, nsvcd__centre_distance(&p, j, p.drawn[s]));
        farthest = fmaxf(farthest, nearest);
        if (i == p.count)
          CHECK_EQ(nearest, nsvcd__centre_distance(&p, p.owners[s], p.drawn[s]));
      }
      if (i < p.count)
        CHECK_EQ(centre, farthest);
    }
    nsvcd__patches_free(&p, NULL);
  }
  nsvcd__patches p = patches_of_points(10, 64);
  for (size_t s = 0; s < 64; ++s) {  // three places for ten centres
    p.drawn[s] = nsvcd__f3_of((float)(s % 3), 5, 5);
  }
  nsvcd__farthest_points(&p);
  CHECK_EQ(p.count, 3);
  nsvcd__patches_free(&p, NULL);
}

static void mesh_centres_without_samples_are_dropped(void) {
  nsvcd__patches p = patches_of_points(4, 64);
  for (size_t s = 0; s < 64; ++s) {
    p.drawn[s].x = (float)s;
    p.owners[s] = s < 32 ? 3 : 1;
  }
  nsvcd__move_centres(&p);
  CHECK_EQ(p.count, 2);
  CHECK_EQ(p.centres[0].x, 47.5);
  CHECK_EQ(p.centres[1].x, 15.5);
  for (size_t s = 0; s < 64; ++s)
    CHECK_EQ(p.owners[s], s < 32);
  // Of two centres at the same distance the first one is nearest, whatever the guess.
  const nsvcd__f3 origin = {0, 0, 0};
  p.centres[0] = nsvcd__f3_of(1, 0, 0);
  p.centres[1] = nsvcd__f3_of(-1, 0, 0);
  nsvcd__link_centres(&p);
  CHECK_EQ(nsvcd__nearest_centre(&p, 0, origin), 0);
  CHECK_EQ(nsvcd__nearest_centre(&p, 1, origin), 0);
  nsvcd__patches_free(&p, NULL);
}

// r^2 N / area: 1/pi for discs that do not overlap, 0.385 for hexagons; all that exceeds it is
// wasted broad phase.
static void mesh_patches_are_round(void) {
  static const size_t counts[] = {64, 128, 256, 512};
  for (int n = 0; n < 4; ++n) {
    nsvcd_mesh mesh = mesh_kind(2);
    nsvcd__patches p;
    double samples = 0;
    double balls = 0;
    CHECK_EQ(nsvcd__patches_build(&mesh, counts[n], NULL, &p), NSVCD_OK);
    for (size_t i = 0; i < p.count; ++i) {
      samples += (double)p.sample_radii[i] / (double)p.count;
      balls += (double)p.radii[i] / (double)p.count;
    }
    double area = nsvcd__mesh_area(&mesh) / (double)p.count;
    printf("N %d: r^2 N / area: samples %.3f, balls %.3f\n", (int)p.count, samples * samples / area,
           balls * balls / area);
    CHECK_LE(samples * samples / area, 0.38);
    CHECK_LE(balls * balls / area, 0.53);
    nsvcd__patches_free(&p, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static int patches_cover(const nsvcd__patches *p, const double *x) {
  for (size_t i = 0; i < p->count; ++i) {
    double d = nsvcd__d3_gap(nsvcd__d3_of(x[0], x[1], x[2]), nsvcd__d3_widen(p->centres[i]));
    if (d <= (double)p->radii[i] * (double)p->radii[i])
      return 1;
  }
  return 0;
}

static void mesh_patches_cover_the_surface(void) {
  static const size_t counts[] = {1, 2, 17, 128, 512};
  long tried = 0;
  long lost = 0;
  mesh_rng = 21;
  for (int kind = 0; kind < MESH_KINDS; ++kind) {
    for (int n = 0; n < 5; ++n) {
      nsvcd_mesh mesh = mesh_kind(kind);
      nsvcd__patches p;
      CHECK_EQ(nsvcd__patches_build(&mesh, counts[n], NULL, &p), NSVCD_OK);
      CHECK(p.count >= 1 && p.count <= counts[n]);
      for (size_t s = 0; s < 6000; ++s) {  // corners, edges and insides of triangles
        double c[3][3];
        double x[3];
        double u = mesh_uniform(0, 1);
        double v = mesh_uniform(0, 1 - u);
        double vector[3];
        size_t t = s < mesh.triangle_count ? s : mesh_below(mesh.triangle_count);
        mesh_triangle(&mesh, t, c, vector);
        if (s % 4 == 1)
          u = 0;
        if (s % 4 == 2) {
          u = 0;
          v = 0;
        }
        for (int k = 0; k < 3; ++k)
          x[k] = c[0][k] + u * (c[1][k] - c[0][k]) + v * (c[2][k] - c[0][k]);
        lost += !patches_cover(&p, x);
        tried++;
      }
      nsvcd__patches_free(&p, NULL);
      nsvcd_mesh_free(&mesh, NULL);
    }
  }
  printf("%ld surface points, %ld outside all balls\n", tried, lost);
  CHECK_EQ(lost, 0);
}

static void mesh_patches_are_consistent(void) {
  for (int kind = 0; kind < MESH_KINDS; ++kind) {
    nsvcd_mesh mesh = mesh_kind(kind);
    nsvcd__patches p;
    CHECK_EQ(nsvcd__patches_build(&mesh, 100, NULL, &p), NSVCD_OK);
    CHECK_EQ(p.sample_count, 3200);
    CHECK_EQ(p.offsets[0], 0);
    CHECK_EQ(p.offsets[p.count], p.sample_count);
    double area = 0;
    double vector[3] = {0, 0, 0};
    double whole[3];
    for (size_t i = 0; i < p.count; ++i) {
      CHECK(p.offsets[i] < p.offsets[i + 1]);
      double mean[3] = {0, 0, 0};
      double samples = p.offsets[i + 1] - p.offsets[i];
      double reach = 0;
      for (size_t s = p.offsets[i]; s < p.offsets[i + 1]; ++s) {
        const float *x = &p.samples[s].x;
        const nsvcd__d3 at = nsvcd__d3_load(x);
        for (int k = 0; k < 3; ++k)
          mean[k] += (double)x[k] / samples;
        reach = fmax(reach, nsvcd__d3_gap(at, nsvcd__d3_widen(p.centres[i])));
        CHECK_NEAR(nsvcd__f3_length(p.normals[s]), 1, 1e-6);
      }
      const float *centre = &p.centres[i].x;
      const float *area_vector = &p.area_vectors[i].x;
      for (size_t k = 0; k < 3; ++k)
        CHECK_NEAR((double)centre[k], mean[k], 1e-6 * fabs(mean[k]) + 1e-12);
      CHECK_NEAR((double)p.sample_radii[i] / sqrt(reach), 1, 1e-6);
      CHECK(p.radii[i] > 0 && nsvcd__is_finite(p.radii[i]));
      area += (double)p.areas[i];
      for (size_t k = 0; k < 3; ++k)
        vector[k] += (double)area_vector[k];
    }
    double total = nsvcd__mesh_area(&mesh);
    CHECK_NEAR(area / total, 1, 1e-6);
    mesh_area_vector(&mesh, whole);
    if (mesh_kind_closed[kind])
      CHECK_LE(vector_length(whole), 1e-9 * total);
    for (int k = 0; k < 3; ++k)
      whole[k] -= vector[k];
    CHECK_LE(vector_length(whole), 1e-6 * total);
    CHECK_LE(p.piece_count, mesh.triangle_count + NSVCD__PIECES_PER_SAMPLE * p.sample_count);
    nsvcd__patches_free(&p, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

// The search from a guess finds what looking at every centre finds.
static void mesh_nearest_centre_is_nearest(void) {
  int tried = 0;
  int wrong = 0;
  mesh_rng = 31;
  for (int kind = 0; kind < MESH_KINDS; ++kind) {
    nsvcd_mesh mesh = mesh_kind(kind);
    nsvcd__patches p;
    CHECK_EQ(nsvcd__patches_build(&mesh, kind % 2 ? 300 : 12, NULL, &p), NSVCD_OK);
    for (int i = 0; i < 3000; ++i) {
      const float *from = &p.samples[mesh_below(p.sample_count)].x;
      double spread = i % 3 * 3 * (double)p.radii[0];
      float x[3];
      for (int k = 0; k < 3; ++k)
        x[k] = from[k] + (float)(spread * mesh_uniform(-1, 1));
      const nsvcd__f3 at = nsvcd__f3_load(x);
      uint32_t found = nsvcd__nearest_centre(&p, (uint32_t)mesh_below(p.count), at);
      uint32_t best = 0;
      for (uint32_t c = 1; c < p.count; ++c) {
        float d = nsvcd__centre_distance(&p, c, at);
        if (d < nsvcd__centre_distance(&p, best, at))
          best = c;
      }
      tried++;
      wrong += found != best;
    }
    nsvcd__patches_free(&p, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
  printf("%d searches, %d wrong\n", tried, wrong);
  CHECK_EQ(wrong, 0);
}

static void mesh_patches_are_deterministic(void) {
  nsvcd_mesh mesh = mesh_kind(4);
  nsvcd__patches a, b, c;
  CHECK_EQ(nsvcd__patches_build(&mesh, 64, NULL, &a), NSVCD_OK);
  CHECK_EQ(nsvcd__patches_build(&mesh, 64, NULL, &b), NSVCD_OK);
  mesh_scale(&mesh, 8);
  CHECK_EQ(nsvcd__patches_build(&mesh, 64, NULL, &c), NSVCD_OK);
  CHECK_EQ(a.count, b.count);
  CHECK(memcmp(a.centres, b.centres, 12 * a.count) == 0 &&
        memcmp(a.radii, b.radii, 4 * a.count) == 0);
  CHECK(memcmp(a.area_vectors, b.area_vectors, 12 * a.count) == 0 &&
        memcmp(a.areas, b.areas, 4 * a.count) == 0);
  CHECK(memcmp(a.samples, b.samples, 12 * a.sample_count) == 0 &&
        memcmp(a.normals, b.normals, 12 * a.sample_count) == 0);
  CHECK(memcmp(a.offsets, b.offsets, 4 * (a.count + 1)) == 0);
  CHECK_EQ(a.count, c.count);  // and a power of two in scale changes nothing else
  for (size_t i = 0; i < a.count && i < c.count; ++i) {
    CHECK_EQ(8 * a.radii[i], c.radii[i]);
    CHECK_EQ(8 * a.centres[i].x, c.centres[i].x);
    CHECK_EQ(64 * a.area_vectors[i].x, c.area_vectors[i].x);
  }
  nsvcd__patches_free(&a, NULL);
  nsvcd__patches_free(&b, NULL);
  nsvcd__patches_free(&c, NULL);
  nsvcd_mesh_free(&mesh, NULL);
}

static void mesh_patches_edge_cases(void) {
  nsvcd_mesh mesh = mesh_box(1, 1, 1);
  nsvcd__patches p, before;
  memset(&p, 0x5a, sizeof p);
  before = p;
  failing_heap heap = {0, 0, 0};
  nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
  allocator.user = &heap;
  // the only allocation fails
  CHECK_EQ(nsvcd__patches_build(&mesh, 8, &allocator, &p), NSVCD_ERROR_MEMORY);
  CHECK_EQ(heap.live, 0);
  CHECK_EQ(heap.calls, 1);
  CHECK(memcmp(&p, &before, sizeof p) == 0);

  // No triangle has an area: then each is sampled alike, and all of them are covered.
  for (int i = 0; i < 36; i += 3)
    mesh.indices[i] = mesh.indices[i + 1];
  CHECK_EQ(nsvcd__patches_build(&mesh, 8, NULL, &p), NSVCD_OK);
  for (size_t i = 0; i < 36; ++i) {
    double x[3];
    for (size_t k = 0; k < 3; ++k)
      x[k] = (double)mesh.positions[3 * mesh.indices[i] + k];
    CHECK(patches_cover(&p, x));
  }
  for (size_t i = 0; i < p.sample_count; ++i)
    CHECK_EQ(nsvcd__f3_length(p.normals[i]), 0);
  nsvcd__patches_free(&p, NULL);
  nsvcd_mesh_free(&mesh, NULL);

  // So small and so far out that all samples fall on a few floats: fewer patches, still covering.
  mesh = mesh_box(0.1, 0.1, 0.1);
  mesh_move(&mesh, 9e5f);
  CHECK_EQ(nsvcd__patches_build(&mesh, 512, NULL, &p), NSVCD_OK);
  CHECK(p.count >= 1 && p.count < 512);
  for (size_t i = 0; i < 8; ++i) {
    double x[3];
    for (size_t k = 0; k < 3; ++k)
      x[k] = (double)mesh.positions[3 * i + k];
    CHECK(patches_cover(&p, x));
  }
  nsvcd__patches_free(&p, NULL);
  nsvcd_mesh_free(&mesh, NULL);
}

static double mesh_total_area(const nsvcd_mesh *mesh) {
  double sum = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    double a[3], b[3], n[3];
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[3 * t];
    for (size_t k = 0; k < 3; k++) {
      a[k] = (double)mesh->positions[3 * (size_t)mesh->indices[3 * t + 1] + k] - (double)p[k];
      b[k] = (double)mesh->positions[3 * (size_t)mesh->indices[3 * t + 2] + k] - (double)p[k];
    }
    for (size_t k = 0; k < 3; k++)
      n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    sum += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  return sum;
}

// A box of 2 x 2 x 2 cut at random: the area left is known, and every vertex lies within.
static void mesh_cut_to_a_box(void) {
  nsvcd_mesh mesh = mesh_box(2, 2, 2);
  nsvcd_mesh part;
  float from[3] = {1e9f, 1e9f, 1e9f};
  float to[3] = {-1e9f, -1e9f, -1e9f};
  for (size_t i = 0; i < 3 * mesh.vertex_count; i++) {
    from[i % 3] = fminf(from[i % 3], mesh.positions[i]);
    to[i % 3] = fmaxf(to[i % 3], mesh.positions[i]);
  }
  for (int trial = 0; trial < 200; trial++) {
    float low[3], high[3];
    double side[3];
    double area = 0;
    for (int k = 0; k < 3; k++) {
      low[k] = from[k] + (float)mesh_uniform(-0.5, 1.9);
      high[k] = low[k] + (float)mesh_uniform(0.1, 3);
      side[k] = (double)(fminf(to[k], high[k]) - fmaxf(from[k], low[k]));
    }
    for (int k = 0; k < 3; k++) {
      int faces = (low[k] < from[k]) + (high[k] > to[k]);
      area += faces * side[(k + 1) % 3] * side[(k + 2) % 3];
    }
    if (fmin(fmin(side[0], side[1]), side[2]) <= 0)
      area = 0;  // the box lies beside it
    nsvcd_result result = nsvcd_mesh_cut(&mesh, low, high, NULL, &part);
    CHECK_EQ(result, area > 0 ? NSVCD_OK : NSVCD_ERROR_EMPTY);
    if (result)
      continue;
    CHECK_NEAR(mesh_total_area(&part), area, 1e-5);
    for (size_t i = 0; i < 3 * part.vertex_count; i++) {
      CHECK(part.positions[i] >= low[i % 3] - 1e-6f && part.positions[i] <= high[i % 3] + 1e-6f);
    }
    CHECK_EQ(nsvcd__mesh_check(&part), NSVCD_OK);
    nsvcd_mesh_free(&part, NULL);
  }
  const float low[3] = {-4, -4, -4};
  const float high[3] = {4, 4, 4};
  const float nan[3] = {0, (float)NAN, 0};
  CHECK_EQ(nsvcd_mesh_cut(&mesh, low, high, NULL, &part), NSVCD_OK);  // all of it
  CHECK_EQ(part.triangle_count, mesh.triangle_count);
  nsvcd_mesh_free(&part, NULL);
  nsvcd_mesh untouched = {NULL, NULL, 7, 7};
  CHECK_EQ(nsvcd_mesh_cut(&mesh, high, low, NULL, &untouched), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_cut(&mesh, low, nan, NULL, &untouched), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_cut(&mesh, NULL, high, NULL, &untouched), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_cut(NULL, low, high, NULL, &untouched), NSVCD_ERROR_ARGUMENT);
  for (int fails = 0; fails < 2; fails++) {
    failing_heap heap = {0, 0, fails};
    nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
    allocator.user = &heap;
    CHECK_EQ(nsvcd_mesh_cut(&mesh, low, high, &allocator, &untouched), NSVCD_ERROR_MEMORY);
    CHECK_EQ(heap.live, 0);
  }
  CHECK_EQ(untouched.vertex_count, 7);
  nsvcd_mesh_free(&mesh, NULL);
}

// Hundreds of thousands of needles, each far longer than a patch is wide: the number of pieces
// stays bounded.
static void mesh_patches_of_slivers(void) {
  nsvcd_mesh mesh = mesh_fan(200000, 100, 0.1);
  nsvcd__patches p;
  CHECK_EQ(nsvcd__patches_build(&mesh, 256, NULL, &p), NSVCD_OK);
  printf("%d slivers, %d pieces\n", (int)mesh.triangle_count, (int)p.piece_count);
  CHECK_LE(p.piece_count, mesh.triangle_count + NSVCD__PIECES_PER_SAMPLE * p.sample_count);
  mesh_rng = 41;
  for (int i = 0; i < 5000; ++i) {
    double x[3] = {mesh_uniform(0, 100), 0, 0};
    x[1] = x[0] * mesh_uniform(0, 0.001) * 0.999;
    CHECK(patches_cover(&p, x));
  }
  nsvcd__patches_free(&p, NULL);
  nsvcd_mesh_free(&mesh, NULL);
}

void test_mesh(void) {
  RUN(mesh_result_strings);
  RUN(mesh_obj_accepted);
  RUN(mesh_obj_refused);
  RUN(mesh_obj_allocation_fails);
  RUN(mesh_obj_counts_are_capped);
  RUN(mesh_obj_numbers);
  RUN(mesh_obj_in_any_locale);
  RUN(mesh_obj_long_lines);
  RUN(mesh_obj_files);
  RUN(mesh_obj_fuzz);
  RUN(mesh_is_checked);
  RUN(mesh_polygons_simple);
  RUN(mesh_polygons_special);
  RUN(mesh_samples_are_uniform);
  RUN(mesh_samples_scale);
  RUN(mesh_samples_lie_mid_stratum);
  RUN(mesh_farthest_points_are_farthest);
  RUN(mesh_centres_without_samples_are_dropped);
  RUN(mesh_patches_are_round);
  RUN(mesh_patches_cover_the_surface);
  RUN(mesh_patches_are_consistent);
  RUN(mesh_nearest_centre_is_nearest);
  RUN(mesh_patches_are_deterministic);
  RUN(mesh_cut_to_a_box);
  RUN(mesh_patches_edge_cases);
  RUN(mesh_patches_of_slivers);
}

CHECK_ALONE(test_mesh)
