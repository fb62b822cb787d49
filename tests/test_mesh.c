// Meshes: OBJ and STL files, checks, polygons, and what is cut at a box.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"
#include "../src/mesh/files.h"
#include "../src/patches/samples.h"

#include "arrays.h"
#include "check.h"
#include "failing_heap.h"
#include "mesh_kinds.h"

#include <locale.h>
#include <stdio.h>

void test_mesh(void);

// --------------------------------------------------------------------------------------------- OBJ

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

#define TETRAHEDRON "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"

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
      // nothing continues a comment, behind whichever statement it stands
      {"v 0 0 0 # one \\\nv 1 0 0 #\\\r\nv 0 1 0 # f 1 2 3 \\\nf 1 2 3 # \\\nv 9 9 9\n# \\\nf 1 2 "
       "4",
       4,
       2,
       {0, 1, 3}},
      {"\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", 3, 1, {0, 1, 2}},  // byte order mark
      // what else is in files: all of it is skipped
      {"mtllib a.mtl\no x\ng y z\ns off\nusemtl m\nvt 0 0\nvn 0 0 1\nvp 1\np 1\nl 1 2\n"
       "cstype rat bspline\ndeg 3\nbmat u 1 0\nstep 1 2\nsurf 0 1 0 1 1 2\ncurv 0 1 1 2\n"
       "curv2 \xff 1 2\nparm u 0 1\ntrim 0 1 1\nhole 0 1 1\nscrv 0 1 1\nsp 1\nend\ncon 1 0 1 1 2\n"
       "mg 1 0.5\nbevel on\nc_interp on\nd_interp off\nlod 5\nusemap m\nmaplib m\n"
       "shadow_obj x\ntrace_obj x\nctech cparm 1\nstech cspace 1\ncall a.obj\ncsh -ls\n"
       "bsp 1\nbzp 1\ncdc 1\ncdp 1\nres 1 2\n" TETRAHEDRON "f 1 2 3\n",
       4,
       1,
       {0, 1, 2}},
      {"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", 3, 1, {0, 1, 2}},       // CR
      {"#\rv 0 0 0\r\nv 1 0 0\nv 0 1 0 #\rf 1 2 3", 3, 1, {0, 1, 2}},  // all three
      {"v 0 0 \\\r0\rv 1 0 0\rv 0 1 0\rf 1 2 \\\r 3\r", 3, 1, {0, 1, 2}},
      {TETRAHEDRON "f 1 1 1\nf 1 2 2\n", 4, 2, {0, 1, 1}},  // no area
      // numbers that are missing behind a slash
      {TETRAHEDRON "f 1// 2// 3//\n", 4, 1, {0, 1, 2}},
      {TETRAHEDRON "f 1/ 2/ 3/\nf -4/ -3// -2//7", 4, 2, {0, 1, 2}},
      {TETRAHEDRON "f 1/1/ 2/1/ 3/1/\r\n", 4, 1, {0, 1, 2}},
      // colours, and what is no weight
      {"v 0 0 0 nan nan nan\nv 1 0 0 -nan(ind) 1 1.#QNAN\nv 0 1 0 inf -Infinity 1e999 -1.#IND 0\n"
       "v 0 0 1 1e39\nf 2 3 4\n",
       4,
       1,
       {1, 2, 3}},
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
    if (result != NSVCD_OK)
      printf("case %d, line %d: %s\n", (int)i, (int)line, nsvcd_result_string(result));
    CHECK_EQ(result, NSVCD_OK);
    if (result != NSVCD_OK) continue;
    CHECK_EQ(line, 0);
    CHECK_EQ(mesh.vertex_count, cases[i].vertices);
    CHECK_EQ(mesh.triangle_count, cases[i].triangles);
    const uint32_t *last = mesh.indices + 3 * (mesh.triangle_count - 1);
    for (int k = 0; k < 3; ++k) CHECK_EQ(last[k], cases[i].last[k]);
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
      {"v 0 0 0 # one \\\nv 1 0 0# \\\n", NSVCD_ERROR_EMPTY, 0},
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
      {TETRAHEDRON "f 1/// 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1/1/1/ 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f // 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1/-/1 2/-/1 3/-/1\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f 1//- 2//1 3//1\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f - 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {TETRAHEDRON "f1 2 3\n", NSVCD_ERROR_SYNTAX, 5},
      {"v1 2 3\n", NSVCD_ERROR_FORMAT, 1},
      {"2v 1 2 3\n", NSVCD_ERROR_FORMAT, 1},
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
      {"v 1 0 1.#INF\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},  // as old Microsoft libraries print it
      {"v nan 0 0\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 0\nv 0 -NaN 0\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 2},
      {"v 0 0 inf\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 -Infinity\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 0 nan nan nan red\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 1},  // a colour
      {"v 0 0 1e39\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 1e999999999999999999999\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 1e15 0\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},
      {"v 0 0 -1000001\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 1},  // beyond NSVCD_MAX_COORDINATE
      {"v 0 0 \\\n\\\n1e7\nf 1 1 1\n", NSVCD_ERROR_NUMBER, 3},
      {"v 0 0 0\n\x01\x02 1 2 3\nf 1 1 1\n", NSVCD_ERROR_SYNTAX, 2},
      {"\x89PNG\r\n\x1a\n", NSVCD_ERROR_FORMAT, 1},
      // lines are counted alike, whatever ends them
      {"v 0 0 0\rv 0 0 1\r\rf 1 2 4\r", NSVCD_ERROR_INDEX, 4},
      {"v 0 0 0\r\nv 0 0 1\r\n\r\nf 1 2 4\r\n", NSVCD_ERROR_INDEX, 4},
      {"v 0 0 0\nv 0 0 1\r\r\nf 1 2 4", NSVCD_ERROR_INDEX, 4},
      {"# \\\rv 0 0 0\rv 0 \\\r\\\r0 1e7\r", NSVCD_ERROR_EMPTY, 0},
      {"# \\\rv 0 0 0\rv 0 \\\r\\\r0 1e7\rf 1 1 1", NSVCD_ERROR_NUMBER, 5},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    for (int fail_at = -1; fail_at < 4; ++fail_at) {
      failing_heap heap = {0, 0, fail_at};
      const nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, &heap};
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

// Counters close to their caps: nobody has 16 GB of text for a test.
static void mesh_obj_counts_are_capped(void) {
  nsvcd__text obj;
  nsvcd__text_begin(&obj, "v\nv\n", 4);
  obj.vertices = 0x7ffffffe;
  CHECK_EQ(nsvcd__obj_count(&obj), NSVCD_ERROR_TOO_LARGE);
  CHECK_EQ(obj.line, 2);
  nsvcd__text_begin(&obj, "f 1 2 3\nf 1 2 3 4\n", 18);
  obj.triangles = 0x7ffffffc;
  CHECK_EQ(nsvcd__obj_count(&obj), NSVCD_OK);
  nsvcd__text_begin(&obj, "f 1 2 3\nf 1 2 3 4\n", 18);
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
    nsvcd__text obj;
    double value = 0;
    nsvcd__text_begin(&obj, text, strlen(text));
    CHECK_EQ(nsvcd__text_number(&obj, &value), NSVCD_OK);
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
    nsvcd__text obj;
    double value = 0;
    nsvcd__text_begin(&obj, exact[i], strlen(exact[i]));
    CHECK_EQ(nsvcd__text_number(&obj, &value), NSVCD_OK);
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
  if (result != NSVCD_OK) return;
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
  for (int i = 0; i < CORNERS; ++i) used += (size_t)sprintf(text + used, " %d/1/1", i % 3 + 1);
  nsvcd_mesh mesh;
  size_t line = 0;
  nsvcd_result result = nsvcd_obj_parse(text, used, NULL, &mesh, &line);
  if (result != NSVCD_OK) printf("line %d: %s\n", (int)line, nsvcd_result_string(result));
  CHECK_EQ(result, NSVCD_OK);
  if (result == NSVCD_OK) {
    CHECK_EQ(mesh.triangle_count, CORNERS - 2);
    CHECK_EQ(mesh.positions[0], 1);
    nsvcd_mesh_free(&mesh, NULL);
  }
  used += (size_t)sprintf(text + used, "\nf 1 2 3\nf 1 2 9\n");
  CHECK_EQ(nsvcd_obj_parse(text, used, NULL, &mesh, &line), NSVCD_ERROR_INDEX);
  CHECK_EQ(line, 500000 + 8);
  // a zigzag of 100,000 corners: concave
  used = 0;
  for (int i = 0; i < 100000; ++i)
    used += (size_t)sprintf(text + used, "v %d %d 0\n", i < 50000 ? i : 100000 - i,
                            i % 2 + (i < 50000 ? 0 : 5));
  used += (size_t)sprintf(text + used, "f");
  for (int i = 0; i < 100000; ++i) used += (size_t)sprintf(text + used, " %d", i + 1);
  CHECK_EQ(nsvcd_obj_parse(text, used, NULL, &mesh, &line), NSVCD_OK);
  CHECK_EQ(mesh.triangle_count, 99998);
  nsvcd_mesh_free(&mesh, NULL);
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
  if (!file) return;
  for (int i = 0; i < 40000; ++i) fprintf(file, "v %d 0.5 0\n", i);  // larger than the first read
  fprintf(file, "f 1 2 40000\nf 1 2 40001\n");
  fclose(file);
  for (int fail_at = -1; fail_at < 12; ++fail_at) {
    failing_heap heap = {0, 0, fail_at};
    const nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, &heap};
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
  file = fopen(path, "wb");  // whatever its name is
  fprintf(file, "solid\nvertex 3000000 0 0\nvertex 3001000 0 0\nvertex 3000000 1000 0\nendloop\n");
  fclose(file);
  const nsvcd_mesh_options options = {NSVCD_MESH_ANY, {3000000, 0, 0}, 0.001};
  CHECK_EQ(nsvcd_mesh_load(path, NULL, NULL, &mesh, &line), NSVCD_ERROR_NUMBER);
  CHECK_EQ(line, 2);
  CHECK_EQ(nsvcd_mesh_load(path, &options, NULL, &mesh, &line), NSVCD_OK);
  CHECK_EQ(mesh.positions[3], 1);
  nsvcd_mesh_free(&mesh, NULL);
  CHECK_EQ(nsvcd_mesh_load(NULL, NULL, NULL, &mesh, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_load("/nowhere/at all.stl", NULL, NULL, &mesh, NULL), NSVCD_ERROR_IO);
  remove(path);
}

// --------------------------------------------------------------------------------------------- STL

// Triangles as an STL file, binary or text; returns its size.
static size_t stl_write(const float *corners, uint32_t triangles, int is_binary, char *out) {
  size_t size = (size_t)sprintf(out, "solid of a vertex and more\n");
  if (is_binary) memset(out + size, ' ', 80 - size);
  if (is_binary) size = 80;
  for (int k = 0; k < 4 && is_binary; k++) out[size++] = (char)(triangles >> (8 * k) & 255);
  for (uint32_t t = 0; t < triangles; t++) {
    const float *at = corners + 9 * t;
    if (!is_binary) size += (size_t)sprintf(out + size, " facet normal 0 0 1\r\n  OUTER loop\n");
    for (int k = 0; k < 12 && is_binary; k++) {
      uint32_t bits = 0x7fc00000;  // normals do not matter
      if (k >= 3) memcpy(&bits, at + k - 3, 4);
      for (int b = 0; b < 4; b++) out[size++] = (char)(bits >> (8 * b) & 255);
    }
    if (is_binary) size += 2;
    for (int k = 0; k < 3 && !is_binary; k++)
      size += (size_t)sprintf(out + size, "   vertex %.9g %.9e %.9g\n", (double)at[3 * k],
                              (double)at[3 * k + 1], (double)at[3 * k + 2]);
    if (!is_binary) size += (size_t)sprintf(out + size, "  endloop\n endfacet\n");
  }
  if (!is_binary) size += (size_t)sprintf(out + size, "endsolid of a vertex");
  return size;
}

// Binary and text give the same mesh: each corner where it was, and no place twice.
#define STL_LOOP "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"

// What is of another format is told so, and not as an OBJ or STL with a fault in it.
static void mesh_of_another_format_is_told_so(void) {
  static const struct {
    const char *text;
    nsvcd_result as_obj, as_stl, as_any;
    size_t line;  // as an OBJ
  } cases[] = {
      {"solid a\nfacet normal 0 0 1\n" STL_LOOP "endfacet\nendsolid a\n", NSVCD_ERROR_FORMAT,
       NSVCD_OK, NSVCD_OK, 1},
      {"\n# a tetrahedron\n" TETRAHEDRON "f 1 2 3\n", NSVCD_OK, NSVCD_ERROR_FORMAT, NSVCD_OK, 0},
      {"ply\nformat ascii 1.0\nelement vertex 1\nend_header\n1 2 3\n", NSVCD_ERROR_FORMAT,
       NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, 5},
      {"OFF\n4 4 6\n0 0 0\n", NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, 2},
      {"\n<!DOCTYPE html>\n", NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, 2},
      {"{\"asset\": {\"version\": \"2.0\"}}", NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT,
       NSVCD_ERROR_FORMAT, 1},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 5\n", NSVCD_ERROR_FORMAT,
       NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, 1},
      {"ISO-10303-21;\nHEADER;\n", NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, NSVCD_ERROR_FORMAT, 1},
      {"mtllib a.mtl\no nothing\n", NSVCD_ERROR_EMPTY, NSVCD_ERROR_FORMAT, NSVCD_ERROR_EMPTY, 0},
      {"# words\n", NSVCD_ERROR_EMPTY, NSVCD_ERROR_FORMAT, NSVCD_ERROR_EMPTY, 0},
  };
  for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
    const char *text = cases[n].text;
    const size_t size = strlen(text);
    for (int format = NSVCD_MESH_ANY; format <= NSVCD_MESH_STL; format++) {
      const nsvcd_result wanted[3] = {cases[n].as_any, cases[n].as_obj, cases[n].as_stl};
      nsvcd_mesh_options options = {(nsvcd_mesh_format)format, {0, 0, 0}, 0};
      nsvcd_mesh mesh = {NULL, NULL, 0, 0};
      size_t line = 99;
      CHECK_EQ(nsvcd_mesh_parse(text, size, &options, NULL, &mesh, &line), wanted[format]);
      if (format == NSVCD_MESH_OBJ) CHECK_EQ(line, cases[n].line);
      nsvcd_mesh_free(&mesh, NULL);
    }
  }
  // binary, and begins with "solid" as some do
  static char binary[400];
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const size_t size = stl_write(corners, 1, 1, binary);
  memcpy(binary, "solid part", 10);
  for (size_t k = 0; k < 3; k++) {
    static const nsvcd_result wanted[3] = {NSVCD_OK, NSVCD_ERROR_FORMAT, NSVCD_OK};
    nsvcd_mesh mesh = {NULL, NULL, 0, 0};
    CHECK_EQ(nsvcd_stl_parse(binary, size - (k == 1) + (k == 2), NULL, &mesh, NULL), wanted[k]);
    CHECK_EQ(mesh.triangle_count, k == 1 ? 0 : 1);
    nsvcd_mesh_free(&mesh, NULL);
  }
  nsvcd_mesh mesh;
  CHECK_EQ(nsvcd_obj_parse(binary, size, NULL, &mesh, NULL), NSVCD_ERROR_FORMAT);
}

// What is held against the limit, and rounded to float, is what becomes of a coordinate in metres.
static void mesh_coordinates_become_metres_in_double(void) {
  static const char *const texts[2] = {
      "v 500000.10 5400000.25 100\nv 500001.10 5400000.25 100\nv 500000.10 5400001.50 100\nf 1 2 3",
      "solid\nvertex 500000.10 5400000.25 100\nvertex 500001.10 5400000.25 100\n"
      "vertex 500000.10 5400001.50 100\nendloop\n"};
  const float wanted[9] = {0.1f, 0.25f, 0, 1.1f, 0.25f, 0, 0.1f, 1.5f, 0};
  static char binary[400];
  const float far_off[9] = {2e6f, 0, 0, 2001000, 0, 0, 2e6f, 1000, 0};
  const size_t size = stl_write(far_off, 1, 1, binary);
  nsvcd_mesh mesh;
  for (size_t n = 0; n < 2; n++) {
    nsvcd_mesh_options options = {NSVCD_MESH_ANY, {500000, 5400000, 100}, 0};
    const size_t length = strlen(texts[n]);
    CHECK_EQ(nsvcd_mesh_parse(texts[n], length, NULL, NULL, &mesh, NULL), NSVCD_ERROR_NUMBER);
    for (int k = 0; k < 3; k++) {
      const double scales[3] = {1, 0.001, 1e5};
      options.scale = scales[k];
      CHECK_EQ(nsvcd_mesh_parse(texts[n], length, &options, NULL, &mesh, NULL), NSVCD_OK);
      for (size_t i = 0; i < 9; i++)
        CHECK_LE(fabs((double)mesh.positions[i] - scales[k] * (double)wanted[i]),
                 1.2e-7 * scales[k]);
      nsvcd_mesh_free(&mesh, NULL);
    }
    options.scale = 1e6;
    CHECK_EQ(nsvcd_mesh_parse(texts[n], length, &options, NULL, &mesh, NULL), NSVCD_ERROR_NUMBER);
    options.scale = -1;
    CHECK_EQ(nsvcd_mesh_parse(texts[n], length, &options, NULL, &mesh, NULL), NSVCD_ERROR_SCALE);
    options.scale = NAN;
    CHECK_EQ(nsvcd_mesh_parse(texts[n], length, &options, NULL, &mesh, NULL), NSVCD_ERROR_SCALE);
    options.scale = 0;
    options.origin[1] = INFINITY;
    CHECK_EQ(nsvcd_mesh_parse(texts[n], length, &options, NULL, &mesh, NULL), NSVCD_ERROR_NUMBER);
  }
  const nsvcd_mesh_options millimetres = {NSVCD_MESH_STL, {0, 0, 0}, 0.001};
  CHECK_EQ(nsvcd_stl_parse(binary, size, NULL, &mesh, NULL), NSVCD_ERROR_NUMBER);
  CHECK_EQ(nsvcd_mesh_parse(binary, size, &millimetres, NULL, &mesh, NULL), NSVCD_OK);
  for (size_t i = 0; i < 9; i++)
    CHECK_LE(fabs((double)mesh.positions[i] - 0.001 * (double)far_off[i]), 2e-4);
  nsvcd_mesh_free(&mesh, NULL);
}

static void mesh_stl_is_read(void) {
  static char text[2][200 * 300];
  static float corners[9 * 200];
  mesh_rng = 5;
  for (uint32_t triangles = 1; triangles <= 200; triangles += 9) {
    nsvcd_mesh meshes[2];
    // of few places, so that many corners are the same; 0 and -0 are
    for (size_t k = 0; k < 9 * triangles; k++) corners[k] = ((float)mesh_below(5) - 2) * 0.1f;
    for (size_t k = 0; k < 9 * triangles; k += 7) corners[k] = mesh_below(2) ? 0.0f : -0.0f;
    for (int n = 0; n < 2; n++) {
      size_t line = 7;
      const size_t size = stl_write(corners, triangles, n, text[n]);
      char *exact = (char *)malloc(size);
      memcpy(exact, text[n], size);
      CHECK_EQ(nsvcd_stl_parse(exact, size, NULL, &meshes[n], &line), NSVCD_OK);
      CHECK_EQ(line, 0);
      free(exact);
      CHECK_EQ(meshes[n].triangle_count, triangles);
      CHECK_EQ(nsvcd__mesh_check(&meshes[n]), NSVCD_OK);
      for (size_t k = 0; k < 9 * triangles; k++)
        CHECK_EQ(meshes[n].positions[3 * meshes[n].indices[k / 3] + k % 3], corners[k]);
      for (size_t a = 0; a < meshes[n].vertex_count; a++) {
        for (size_t b = 0; b < a; b++)
          CHECK(memcmp(meshes[n].positions + 3 * a, meshes[n].positions + 3 * b, 12) != 0);
      }
    }
    CHECK_EQ(meshes[0].vertex_count, meshes[1].vertex_count);
    CHECK_EQ(memcmp(meshes[0].indices, meshes[1].indices, 12 * triangles), 0);
    for (int n = 0; n < 2; n++) nsvcd_mesh_free(&meshes[n], NULL);
  }
  nsvcd_mesh mesh;
  CHECK_EQ(nsvcd_stl_load("no/such/file.stl", NULL, &mesh, NULL), NSVCD_ERROR_IO);
}

static void mesh_stl_is_refused(void) {
  static const struct {
    const char *text;
    nsvcd_result result;
    size_t line;
  } cases[] = {
      {"solid\n" STL_LOOP, NSVCD_OK, 0},
      {"solid", NSVCD_ERROR_EMPTY, 0},
      {"solid a\nendsolid a\n", NSVCD_ERROR_EMPTY, 0},
      {"solid\n" STL_LOOP "vertex 0 0 0", NSVCD_ERROR_SYNTAX, 7},
      {"solid\nvertex 0 0 0\nvertex 1 0 0\nendloop", NSVCD_ERROR_SYNTAX, 4},
      {"solid\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0 1\nvertex 1 1 0\nendloop", NSVCD_ERROR_SYNTAX,
       6},
      {"solid\nvertex 0 0 0\nvertex 1 0 x\nvertex 1 0 1\nendloop", NSVCD_ERROR_SYNTAX, 3},
      {"solid\nvertex 0 0 0\nvertex 1 0 nan\nvertex 1 0 1\nendloop", NSVCD_ERROR_NUMBER, 3},
      {"solid\nvertex 0 0 0\nvertex 1 0 9e37\nvertex 1 0 1\nendloop", NSVCD_ERROR_NUMBER, 3},
      {"solid\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0", NSVCD_ERROR_SYNTAX, 4},
      {"", NSVCD_ERROR_FORMAT, 0},
      {"ply\n", NSVCD_ERROR_FORMAT, 0},
  };
  for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
    nsvcd_mesh mesh = {NULL, NULL, 7, 7};
    size_t line = 99;
    const size_t size = strlen(cases[n].text);
    char *exact = (char *)malloc(size + 1);
    memcpy(exact, cases[n].text, size);
    const nsvcd_result result = nsvcd_stl_parse(exact, size, NULL, &mesh, &line);
    free(exact);
    if (result != cases[n].result || line != cases[n].line)
      printf("  case %zu: %d, line %zu\n", n, (int)result, line);
    CHECK_EQ(result, cases[n].result);
    CHECK_EQ(line, cases[n].line);
    if (!result)
      nsvcd_mesh_free(&mesh, NULL);
    else
      CHECK_EQ(mesh.vertex_count, 7);
  }
  // binary: cut off, not finite, too large, a count that is none
  static char binary[400];
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const size_t size = stl_write(corners, 1, 1, binary);
  nsvcd_mesh mesh;
  size_t line = 99;
  CHECK_EQ(nsvcd_stl_parse(binary, size, NULL, &mesh, &line), NSVCD_OK);
  nsvcd_mesh_free(&mesh, NULL);
  memcpy(binary, "SOLED", 5);
  CHECK_EQ(nsvcd_stl_parse(binary, size - 1, NULL, &mesh, &line), NSVCD_ERROR_FORMAT);
  CHECK_EQ(line, 0);
  binary[84 + 12 + 3] = 0x7f;
  binary[84 + 12 + 2] = (char)0x80;
  CHECK_EQ(nsvcd_stl_parse(binary, size, NULL, &mesh, &line), NSVCD_ERROR_NUMBER);
  memset(binary + 80, 0xff, 4);
  CHECK_EQ(nsvcd_stl_parse(binary, size, NULL, &mesh, &line), NSVCD_ERROR_FORMAT);
  CHECK_EQ(nsvcd_stl_parse(NULL, size, NULL, &mesh, &line), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_stl_parse(binary, size, NULL, NULL, &line), NSVCD_ERROR_ARGUMENT);
}

// Vertices that are chosen to share a slot of the table: it takes another hash, and stays linear.
static void mesh_welds_share_no_hash(void) {
  enum { CORNERS = 1500, SLOTS = 4096 };
  static float positions[3 * CORNERS];
  static uint32_t welded[CORNERS], table[SLOTS];
  nsvcd__weld w = {positions, table, SLOTS, 0, 0};
  mesh_rng = 6;
  for (size_t n = 0; n < CORNERS;) {
    float *corner = positions + 3 * n;
    for (size_t k = 0; k < 3; k++) corner[k] = (float)mesh_uniform(-1, 1);
    n += nsvcd__weld_slot(&w, n) == table;
  }
  nsvcd__weld_vertices(&w, CORNERS, welded);
  // not one that can be known beforehand
  CHECK(w.seed != 0 && w.seed != UINT64_C(0xd1342543de82ef95));
  CHECK_LE(w.steps, 8 * CORNERS + 1024);
  for (size_t n = 0; n < CORNERS; n++) CHECK_EQ(welded[n], n);
}

// ---------------------------------------------------------------------------------------- polygons

enum { POLYGON_MAX = 20000 };

// Triangulates a polygon given in the plane after placing it in space; returns the sum of the
// triangles' areas over the polygon's (1 if they cover it without overlap), and checks that the
// vector areas agree.
static double polygon_cover(const double (*xy)[2], uint32_t count) {
  static float positions[3 * POLYGON_MAX];
  static uint32_t triangles[3 * POLYGON_MAX];
  nsvcd_mesh mesh = {positions, triangles, 0, 0};
  nsvcd__polygon polygon;
  float q[4];
  float m[9];
  float norm = 0;
  for (int k = 0; k < 4; ++k) {
    q[k] = (float)mesh_uniform(-1, 1);
    norm += q[k] * q[k];
  }
  for (int k = 0; k < 4; ++k) q[k] /= sqrtf(norm);
  matrix_of_quat(q, m);
  double area = 0;
  double covered = 0;
  double vector[3];
  double normal[3];
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  CHECK(nsvcd__polygon_alloc(&polygon, count, &arena));
  polygon.count = count;
  for (uint32_t i = 0; i < count; ++i) {
    const double *a = xy[i];
    const double *b = xy[(i + 1) % count];
    float flat[3] = {(float)a[0], (float)a[1], 0.3f};
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    mul33_vec(m, flat, positions + 3 * i);
    polygon.corners[i].vertex = i;
  }
  nsvcd__polygon_triangulate(&polygon, positions, triangles);
  nsvcd__arena_free(&arena);
  mesh.vertex_count = count;
  mesh.triangle_count = count - 2;
  CHECK_EQ(nsvcd__mesh_check(&mesh), NSVCD_OK);
  for (size_t t = 0; t < mesh.triangle_count; ++t) {
    double corner[3][3], v[3];
    covered += mesh_triangle(&mesh, t, corner, v);
  }
  mesh_area_vector(&mesh, vector);
  for (int k = 0; k < 3; ++k) normal[k] = area * (double)m[3 * k + 2] - vector[k];
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

static const char *const large_kinds[] = {"zigzag", "star", "spiral", "spikes", "circle"};
enum { LARGE_KINDS = sizeof large_kinds / sizeof *large_kinds };

// Corner i of n of a polygon of many corners, counter-clockwise.
static void large_corner(int kind, uint32_t i, uint32_t n, double *xy) {
  const double turn = 2 * 3.14159265358979323846 * i / n;
  const uint32_t half = n / 2;
  const int back = i >= half;
  const double along = (double)(back ? n - 1 - i : i) / half;
  double angle = turn;
  double r = 1;
  switch (kind) {
    case 0:  // two rows of teeth, which do not touch
      xy[0] = along;
      xy[1] = (i % 2 ? 1e-3 : 0) + (back ? 5e-3 : 0);
      return;
    case 1:
      r = mesh_uniform(0.2, 1);
      break;
    case 2:  // out along one side, back along the other
      angle = 200 * along;
      r = 0.1 + 0.05 * angle + (back ? 0.02 : 0);
      break;
    case 3:  // on a base line; the first two corners are its ends
      xy[0] = i < 2 ? i : 1 - (double)(i - 1) / (n - 1);
      xy[1] = i < 2 ? 0 : mesh_uniform(0.01, 1);
      return;
    default:  // as %.6f writes it: rounding makes some corners reflex
      xy[0] = floor(1e6 * cos(angle) + 0.5) / 1e6;
      xy[1] = floor(1e6 * sin(angle) + 0.5) / 1e6;
      return;
  }
  xy[0] = r * cos(angle);
  xy[1] = r * sin(angle);
}

// The seconds that it takes to hold each 16th ear of a polygon against all corners.
static double large_seconds_of_all(const double (*xy)[2], uint32_t n) {
  size_t held = 0;
  const clock_t start = clock();
  for (uint32_t i = 0; i + 2 < n; i += 16) {
    nsvcd__ear ear = {{{0, 0}, {0, 0}, {0, 0}}, NSVCD__NO_BOX};
    for (uint32_t k = 0; k < 3; k++) ear.at[k] = (nsvcd__d2){xy[i + k][0], xy[i + k][1]};
    for (uint32_t k = 0; k < n; k++)
      held += (size_t)nsvcd__ear_holds(&ear, (nsvcd__d2){xy[k][0], xy[k][1]});
  }
  const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
  CHECK_LE(held, (size_t)n * n);
  return seconds;
}

// Faces of thousands of corners are covered as those of few are, and their time does not grow with
// the square: each ear is held against the corners about it, not against all.
static void mesh_polygons_large(void) {
  static double xy[POLYGON_MAX][2];
  mesh_rng = 13;
  for (int kind = 0; kind < LARGE_KINDS; kind++) {
    double seconds = 0;
    for (uint32_t n = POLYGON_MAX / 4; n <= POLYGON_MAX; n *= 4) {
      for (uint32_t i = 0; i < n; i++) large_corner(kind, i, n, xy[i]);
      const clock_t start = clock();
      CHECK_NEAR(polygon_cover((const double(*)[2])xy, n), 1, 1e-4);
      seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    }
    const double all = 16 * large_seconds_of_all((const double(*)[2])xy, POLYGON_MAX);
    printf("%s: %.2g of the time of all ears against all corners\n", large_kinds[kind],
           seconds / all);
    CHECK_LE(seconds, 0.2 * all);
  }
}

// -------------------------------------------------------------------------------------------- cuts

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
    if (fmin(fmin(side[0], side[1]), side[2]) <= 0) area = 0;  // the box lies beside it
    nsvcd_result result = nsvcd_mesh_cut(&mesh, low, high, NULL, &part);
    CHECK_EQ(result, area > 0 ? NSVCD_OK : NSVCD_ERROR_EMPTY);
    if (result) continue;
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
  CHECK_EQ(nsvcd_mesh_cut(&mesh, high, low, NULL, &untouched), NSVCD_ERROR_BOX);
  CHECK_EQ(nsvcd_mesh_cut(&mesh, low, nan, NULL, &untouched), NSVCD_ERROR_BOX);
  CHECK_EQ(nsvcd_mesh_cut(&mesh, NULL, high, NULL, &untouched), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_cut(NULL, low, high, NULL, &untouched), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(untouched.vertex_count, 7);
  nsvcd_mesh_free(&mesh, NULL);
}

void test_mesh(void) {
  RUN(mesh_obj_accepted);
  RUN(mesh_obj_refused);
  RUN(mesh_obj_counts_are_capped);
  RUN(mesh_obj_numbers);
  RUN(mesh_obj_in_any_locale);
  RUN(mesh_obj_long_lines);
  RUN(mesh_obj_files);
  RUN(mesh_of_another_format_is_told_so);
  RUN(mesh_coordinates_become_metres_in_double);
  RUN(mesh_stl_is_read);
  RUN(mesh_stl_is_refused);
  RUN(mesh_welds_share_no_hash);
  RUN(mesh_polygons_simple);
  RUN(mesh_polygons_special);
  RUN(mesh_polygons_large);
  RUN(mesh_cut_to_a_box);
}

CHECK_ALONE(test_mesh)
