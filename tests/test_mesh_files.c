// Meshes from faces of the caller, and from the bytes of files: PLY, GLB, and which of four formats.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/ground/strings.h"
#include "../src/mesh/faces.h"
#include "../src/mesh/files.h"
#include "../src/patches/samples.h"

#include "check.h"
#include "failing_heap.h"

// The readers' own memory, from a heap that fails on purpose.
static int files_taken, files_live, files_fail_at = -1;
static void *files_realloc(void *memory, size_t size) {
  if (files_taken++ == files_fail_at) return NULL;
  files_live += !memory;
  return realloc(memory, size);
}
static void files_free(void *memory) {
  files_live -= memory != NULL;
  free(memory);
}
#define malloc(size) files_realloc(NULL, size)
#define realloc files_realloc
#define free files_free
#include "../examples/scenery/mesh_files.h"
#undef malloc
#undef realloc
#undef free

#include "mesh_kinds.h"

#include <locale.h>
#include <stdarg.h>
#include <stdio.h>

void test_mesh_files(void);

// A file that is being written.
typedef struct bytes {
  char at[1 << 20];
  size_t size;
} bytes;

static void put(bytes *out, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  out->size +=
      (size_t)vsnprintf(out->at + out->size, sizeof out->at - out->size, format, arguments);
  va_end(arguments);
}
static void put_word(bytes *out, uint64_t word, size_t count, int big) {
  for (size_t k = 0; k < count; k++)
    out->at[out->size++] = (char)(word >> 8 * (big ? count - 1 - k : k) & 255);
}
static void put_float(bytes *out, double value, int big) {
  const float narrow = (float)value;
  uint32_t word;
  memcpy(&word, &narrow, sizeof word);
  put_word(out, word, 4, big);
}

// From an exact copy on the heap, so that the sanitizer sees each read past the end. What is refused
// has a reason, and leaves the mesh as it was.
static int parse(const char *name, const void *data, size_t size, nsvcd_mesh *mesh,
                 mesh_fault *fault) {
  char *exact = (char *)malloc(size + 1);
  memset(mesh, 7, sizeof *mesh);
  const nsvcd_mesh before = *mesh;
  memcpy(exact + 1, data, size);
  const int good = mesh_parse(name, exact + 1, size, NULL, mesh, fault);
  free(exact);
  CHECK(good == !fault->reason);
  CHECK(good || memcmp(&before, mesh, sizeof before) == 0);
  if (good) CHECK_EQ(nsvcd__mesh_check(mesh), NSVCD_OK);
  if (good) CHECK_EQ(fault->line, 0);
  return good;
}

static void check_refused(const char *name, const void *data, size_t size, const char *format,
                          size_t line, const char *reason) {
  nsvcd_mesh mesh;
  mesh_fault fault;
  if (parse(name, data, size, &mesh, &fault)) {
    printf("  accepted, and should be: %s\n", reason);
    CHECK(!"accepted");
    nsvcd_mesh_free(&mesh, NULL);
    return;
  }
  const int is_so = strcmp(fault.format, format) == 0 && fault.line == line && fault.reason &&
                    strstr(fault.reason, reason);
  if (!is_so)
    printf("  %s, line %d: %s; expected %s, line %d: %s\n", fault.format, (int)fault.line,
           fault.reason, format, (int)line, reason);
  CHECK(is_so);
}

static int same(const nsvcd_mesh *a, const nsvcd_mesh *b) {
  return a->vertex_count == b->vertex_count && a->triangle_count == b->triangle_count &&
         memcmp(a->positions, b->positions, 12 * a->vertex_count) == 0 &&
         memcmp(a->indices, b->indices, 12 * a->triangle_count) == 0;
}

// Every beginning of a good file is refused, or is a mesh; no byte behind it is read.
static void check_prefixes(const char *name, const bytes *file, size_t least) {
  nsvcd_mesh mesh;
  mesh_fault fault;
  for (size_t size = 0; size < file->size; size++) {
    const int good = parse(name, file->at, size, &mesh, &fault);
    CHECK(!good || size >= least);
    if (good) nsvcd_mesh_free(&mesh, NULL);
  }
}

// ------------------------------------------------------------------------------------------- faces

typedef struct polygons {
  float positions[3 * 600];
  uint32_t corners[2000], sizes[60];
  nsvcd_faces faces;
} polygons;

// Faces of 3 to 20 corners, most of them concave, on places of their own or of others.
static void polygons_random(polygons *out, int whole) {
  memset(out, 0, sizeof *out);
  nsvcd_faces *faces = &out->faces;
  faces->positions = out->positions;
  faces->corners = out->corners;
  faces->sizes = out->sizes;
  faces->face_count = 1 + mesh_below(20);
  for (size_t f = 0; f < faces->face_count; f++) {
    const uint32_t size = mesh_below(3) ? 3 + (uint32_t)mesh_below(18) : 3;
    const double z = mesh_uniform(-1, 1);
    for (uint32_t i = 0; i < size; i++) {
      const double turn = 6.2831853 * i / size;
      const double far = whole ? 60 : mesh_uniform(0.1, 1);
      float *p = out->positions + 3 * faces->vertex_count;
      p[0] = (float)(far * cos(turn));
      p[1] = (float)(far * sin(turn) + z);
      p[2] = (float)(far * z);
      for (int k = 0; k < 3 && whole; k++) p[k] = (float)(64 + floor((double)p[k] / 2));
      const uint32_t other = (uint32_t)mesh_below(faces->vertex_count + 1);
      out->corners[faces->corner_count++] = mesh_below(10) ? (uint32_t)faces->vertex_count : other;
      faces->vertex_count++;
    }
    out->sizes[f] = size;
  }
}

static void obj_write(bytes *out, const nsvcd_faces *faces) {
  const uint32_t *corner = faces->corners;
  out->size = 0;
  for (size_t v = 0; v < faces->vertex_count; v++)
    put(out, "v %.9g %.9g %.9g\n", (double)faces->positions[3 * v],
        (double)faces->positions[3 * v + 1], (double)faces->positions[3 * v + 2]);
  for (size_t f = 0; f < faces->face_count; f++) {
    put(out, "f");
    for (uint32_t i = 0; i < faces->sizes[f]; i++) put(out, " %u", *corner++ + 1);
    put(out, "\n");
  }
}

static bytes file;
static polygons shape;

static void mesh_of_faces_is_that_of_obj(void) {
  mesh_rng = 11;
  for (int n = 0; n < 2000; n++) {
    nsvcd_mesh mesh = {NULL, NULL, 0, 0};
    nsvcd_mesh of_obj = {NULL, NULL, 0, 0};
    polygons_random(&shape, 0);
    obj_write(&file, &shape.faces);
    CHECK_EQ(nsvcd_obj_parse(file.at, file.size, NULL, &of_obj, NULL), NSVCD_OK);
    CHECK_EQ(nsvcd_mesh_of_faces(&shape.faces, NULL, &mesh), NSVCD_OK);
    CHECK(same(&mesh, &of_obj));
    nsvcd_mesh_free(&mesh, NULL);
    nsvcd_mesh_free(&of_obj, NULL);
  }
  for (int kind = 0; kind < MESH_KINDS; kind++) {  // triangles need no sizes
    nsvcd_mesh made = mesh_kind(kind);
    nsvcd_mesh mesh = {NULL, NULL, 0, 0};
    nsvcd_faces faces = {made.positions,          made.indices,       NULL, made.vertex_count,
                         3 * made.triangle_count, made.triangle_count};
    CHECK_EQ(nsvcd_mesh_of_faces(&faces, NULL, &mesh), NSVCD_OK);
    CHECK(same(&mesh, &made));
    nsvcd_mesh_free(&mesh, NULL);
    nsvcd_mesh_free(&made, NULL);
  }
}

static void mesh_of_faces_refuses(void) {
  static float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static uint32_t corners[8] = {0, 1, 2, 0, 1, 2, 3, 3};
  static uint32_t sizes[2] = {3, 4};
  const nsvcd_faces good = {positions, corners, sizes, 4, 7, 2};
  nsvcd_faces faces = good;
  nsvcd_mesh mesh;
  memset(&mesh, 7, sizeof mesh);
  const nsvcd_mesh before = mesh;
  failing_heap heap = {0, 0, -1};
  const nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, &heap};
#define REFUSED(change, result)                                       \
  do {                                                                \
    faces = good;                                                     \
    change;                                                           \
    CHECK_EQ(nsvcd_mesh_of_faces(&faces, &allocator, &mesh), result); \
    CHECK_EQ(heap.live, 0);                                           \
    CHECK_EQ(memcmp(&mesh, &before, sizeof mesh), 0);                 \
  } while (0)
  CHECK_EQ(nsvcd_mesh_of_faces(NULL, &allocator, &mesh), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_of_faces(&faces, &allocator, NULL), NSVCD_ERROR_ARGUMENT);
  REFUSED(faces.positions = NULL, NSVCD_ERROR_ARGUMENT);
  REFUSED(faces.corners = NULL, NSVCD_ERROR_ARGUMENT);
  REFUSED((faces.positions = NULL, faces.face_count = faces.corner_count = 0),
          NSVCD_ERROR_ARGUMENT);
  // sizes that are not those of the corners
  REFUSED(faces.corner_count = 6, NSVCD_ERROR_SIZES);
  REFUSED(faces.corner_count = 8, NSVCD_ERROR_SIZES);
  REFUSED(faces.corner_count = 0, NSVCD_ERROR_SIZES);
  REFUSED(faces.face_count = 0, NSVCD_ERROR_SIZES);
  REFUSED(faces.face_count = 1, NSVCD_ERROR_SIZES);
  REFUSED(faces.sizes = NULL, NSVCD_ERROR_SIZES);
  REFUSED((faces.sizes = NULL, faces.face_count = SIZE_MAX), NSVCD_ERROR_SIZES);
  for (uint32_t size = 0; size < 3; size++) {
    sizes[0] = size;
    REFUSED(faces.corner_count = size + 4, NSVCD_ERROR_SIZES);
  }
  sizes[0] = 0xffffffffu;
  REFUSED(faces = good, NSVCD_ERROR_SIZES);
  sizes[0] = 3;
  REFUSED(faces.vertex_count = 3, NSVCD_ERROR_INDEX);
  REFUSED(faces.vertex_count = 0, NSVCD_ERROR_INDEX);
  REFUSED(faces.vertex_count = (size_t)NSVCD__MAX_COUNT + 1, NSVCD_ERROR_TOO_LARGE);
  REFUSED(faces.vertex_count = SIZE_MAX, NSVCD_ERROR_TOO_LARGE);
  REFUSED((faces.face_count = faces.corner_count = 0), NSVCD_ERROR_EMPTY);
  corners[6] = 0xffffffffu;
  REFUSED(faces = good, NSVCD_ERROR_INDEX);
  corners[6] = 3;
  static const float bad[] = {NAN, HUGE_VALF, -HUGE_VALF, 2 * NSVCD_MAX_COORDINATE};
  for (size_t k = 0; k < 12 * sizeof bad / sizeof *bad; k++) {
    const float was = positions[k % 12];
    positions[k % 12] = bad[k / 12];
    REFUSED(faces = good, NSVCD_ERROR_NUMBER);
    positions[k % 12] = was;
  }
#undef REFUSED
  // without memory, at whichever place
  int failures = 0;
  for (nsvcd_result result = NSVCD_ERROR_MEMORY; result; failures++) {
    heap.calls = 0;
    heap.fail_at = failures;
    result = nsvcd_mesh_of_faces(&good, &allocator, &mesh);
    CHECK(result == NSVCD_OK || result == NSVCD_ERROR_MEMORY);
    CHECK(!result || memcmp(&mesh, &before, sizeof mesh) == 0);
    if (!result) nsvcd_mesh_free(&mesh, &allocator);
    CHECK_EQ(heap.live, 0);
  }
  CHECK_GE(failures, 3);
}

// --------------------------------------------------------------------------------------------- PLY

enum { PLY_TYPES = 16 };
static const char *const ply_names[PLY_TYPES] = {
    "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

static void ply_put(bytes *out, int format, int type, double value) {
  static const size_t widths[8] = {1, 1, 2, 2, 4, 4, 4, 8};
  type %= 8;
  if (format == 0) {
    put(out, "%.9g ", value);
  } else if (type == 6) {
    put_float(out, value, format == 2);
  } else if (type == 7) {
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    put_word(out, word, 8, format == 2);
  } else {
    put_word(out, (uint64_t)(int64_t)value, widths[type], format == 2);
  }
}

typedef struct ply_kinds {
  int format;                        // text, little, big
  int place, length, corner, other;  // types
  int extras;  // bits: properties before, between and behind; of faces; elements before and behind
  const char *newline;
} ply_kinds;

static void ply_put_list(bytes *out, const ply_kinds *k, size_t length) {
  ply_put(out, k->format, k->length, (double)length);
  for (size_t i = 0; i < length; i++) ply_put(out, k->format, k->other, (double)(i % 100));
}
static void ply_put_line_end(bytes *out, const ply_kinds *k) {
  if (k->format == 0) put(out, "%s", k->newline);
}

static void ply_write(bytes *out, const nsvcd_faces *faces, const ply_kinds *k) {
  static const char *const formats[3] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const char *end = k->newline;
  const char *other = ply_names[k->other];
  const char *length = ply_names[k->length];
  const uint32_t *corner = faces->corners;
  out->size = 0;
  put(out, "ply%sformat %s 1.0%scomment element vertex 99%s", end, formats[k->format], end, end);
  if (k->extras & 16)
    put(out, "obj_info x%selement camera 2%sproperty %s fov%sproperty list %s %s marks%s", end, end,
        other, end, length, other, end);
  put(out, "element vertex %u%s", (unsigned)faces->vertex_count, end);
  for (int i = 0; i < 3; i++) {
    if (k->extras & 1 << i) put(out, "property  %s\tn%d%s", other, i, end);
    put(out, "property %s %c%s", ply_names[k->place], "xyz"[i], end);
  }
  if (k->extras & 8) put(out, "property list %s %s rings%s", length, other, end);
  put(out, "element face %u%s", (unsigned)faces->face_count, end);
  if (k->extras & 8) put(out, "property list %s %s uv%s", length, other, end);
  put(out, "property list %s %s %s%s", length, ply_names[k->corner],
      k->extras & 1 ? "vertex_index" : "vertex_indices", end);
  if (k->extras & 4) put(out, "property %s flags%s", other, end);
  if (k->extras & 32) put(out, "element edge 3%sproperty %s a%s", end, other, end);
  put(out, "end_header%s", end);
  for (int i = 0; i < 2 && k->extras & 16; i++) {
    ply_put(out, k->format, k->other, 55);
    ply_put_list(out, k, (size_t)i * 4);
    ply_put_line_end(out, k);
  }
  for (size_t v = 0; v < faces->vertex_count; v++) {
    for (int i = 0; i < 3; i++) {
      if (k->extras & 1 << i) ply_put(out, k->format, k->other, 77);
      ply_put(out, k->format, k->place, (double)faces->positions[3 * v + (size_t)i]);
    }
    if (k->extras & 8) ply_put_list(out, k, v % 3);
    ply_put_line_end(out, k);
  }
  for (size_t f = 0; f < faces->face_count; f++) {
    if (k->extras & 8) ply_put_list(out, k, f % 5);
    ply_put(out, k->format, k->length, faces->sizes[f]);
    for (uint32_t i = 0; i < faces->sizes[f]; i++) ply_put(out, k->format, k->corner, *corner++);
    if (k->extras & 4) ply_put(out, k->format, k->other, 3);
    ply_put_line_end(out, k);
  }
  for (int i = 0; i < 3 && k->extras & 32; i++) ply_put(out, k->format, k->other, i);
}

static ply_kinds ply_random(int whole) {
  ply_kinds k;
  k.format = (int)mesh_below(3);
  k.place = whole ? (int)mesh_below(PLY_TYPES) : 6 + 8 * (int)mesh_below(2);
  k.length = (int)mesh_below(PLY_TYPES);
  k.corner = 2 + (int)mesh_below(6);
  k.other = (int)mesh_below(PLY_TYPES);
  k.extras = (int)mesh_below(64);
  static const char *const newlines[4] = {"\n", "\n", "\r\n", "\r"};
  k.newline = newlines[mesh_below(4)];
  return k;
}

// Whatever types, further properties and elements it has, text or binary: the mesh is that of OBJ.
static void mesh_ply_is_read(void) {
  mesh_rng = 12;
  for (int n = 0; n < 4000; n++) {
    nsvcd_mesh of_obj, mesh;
    mesh_fault fault;
    const ply_kinds kinds = ply_random(n % 2);
    const int place = kinds.place % 8;
    polygons_random(&shape, n % 2);
    for (size_t i = 0; i < 3 * shape.faces.vertex_count && place != 1 && place != 3 && place != 5;
         i++)
      shape.positions[i] *= -1;
    // of three bytes' meaning as floats, and as an end of a line
    if (n % 8 == 0) memcpy(shape.positions, "\n\n\n\x3d", 4);
    obj_write(&file, &shape.faces);
    CHECK_EQ(nsvcd_obj_parse(file.at, file.size, NULL, &of_obj, NULL), NSVCD_OK);
    ply_write(&file, &shape.faces, &kinds);
    if (!parse("", file.at, file.size, &mesh, &fault)) {
      printf("  %s line %d: %.300s\n", fault.reason, (int)fault.line, file.at);
      CHECK(!"refused");
    } else {
      CHECK(same(&mesh, &of_obj));
      nsvcd_mesh_free(&mesh, NULL);
    }
    nsvcd_mesh_free(&of_obj, NULL);
  }
}

// Strips of triangles, in every format, are the triangles that they are by definition.
static void mesh_ply_strips(void) {
  static const char *const formats[3] = {"ascii", "binary_little_endian", "binary_big_endian"};
  mesh_rng = 14;
  for (int n = 0; n < 600; n++) {
    const int format = n % 3;
    const int corner =
        format && n % 7 == 0 ? 5 : 2 * (int)mesh_below(4);  // 5: unsigned, of which -1 is the last
    const size_t rows = 1 + mesh_below(3);
    uint32_t wanted[3 * 200];
    size_t triangles = 0;
    nsvcd_mesh mesh;
    mesh_fault fault;
    file.size = 0;
    put(&file, "ply\nformat %s 1.0\nelement vertex 9\nproperty short x\n", formats[format]);
    put(&file, "property short y\nproperty short z\nelement tristrips %d\n", (int)rows);
    put(&file, "property list uchar %s vertex_%s\nend_header\n", ply_names[corner],
        n % 2 ? "indices" : "index");
    for (int i = 0; i < 27; i++) ply_put(&file, format, 2, i * i % 31);
    for (size_t row = 0; row < rows; row++) {
      int strip[40];
      const size_t count = mesh_below(40);
      ply_put(&file, format, 1, (double)count);
      for (size_t i = 0, first = 0; i < count; i++) {
        strip[i] = (int)mesh_below(10) - 1;
        ply_put(&file, format, corner, strip[i] < 0 && corner == 5 ? 4294967295.0 : strip[i]);
        if (strip[i] < 0) first = i + 1;
        if (i < first + 2 || strip[i] < 0) continue;
        const int odd = (i - first) % 2 == 1;
        const int a = strip[i - 2 + (size_t)odd];
        const int b = strip[i - 1 - (size_t)odd];
        if (a == b || b == strip[i] || a == strip[i]) continue;
        wanted[3 * triangles] = (uint32_t)a;
        wanted[3 * triangles + 1] = (uint32_t)b;
        wanted[3 * triangles++ + 2] = (uint32_t)strip[i];
      }
    }
    if (triangles == 0) {
      CHECK(!parse("", file.at, file.size, &mesh, &fault));
    } else if (parse("", file.at, file.size, &mesh, &fault)) {
      CHECK_EQ(mesh.triangle_count, triangles);
      CHECK(memcmp(mesh.indices, wanted, 3 * triangles * sizeof *wanted) == 0);
      nsvcd_mesh_free(&mesh, NULL);
    } else {
      printf("  %d: %s\n", n, fault.reason);
      CHECK(!"refused");
    }
  }
}

// Of every format: a place is taken off, and what is left scaled, in double; the limit is one of
// metres.
static void mesh_files_become_metres_in_double(void) {
  static const char ply[] =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "500000.10 5400000.00 7\n500001.10 5400000.00 7\n500000.10 5400001.00 7\n3 0 1 2\n";
  static const char obj[] =
      "v 500000.10 5400000.00 7\nv 500001.10 5400000.00 7\nv 500000.10 5400001.00 7\nf 1 2 3\n";
  const float wanted[9] = {0.1f, 0, 0, 1.1f, 0, 0, 0.1f, 1, 0};
  const nsvcd_mesh_options placed = {NSVCD_MESH_ANY, {500000, 5400000, 7}, 0.5};
  for (int n = 0; n < 2; n++) {
    const char *text = n ? obj : ply;
    nsvcd_mesh mesh;
    mesh_fault fault;
    CHECK(!parse("", text, strlen(text), &mesh, &fault));
    CHECK(fault.reason == NULL ||
          strcmp(fault.reason, nsvcd_result_string(NSVCD_ERROR_NUMBER)) == 0);
    CHECK(mesh_parse_to("", text, strlen(text), &placed, NULL, &mesh, &fault));
    for (int i = 0; i < 9 && !fault.reason; i++)
      CHECK_LE(fabs((double)mesh.positions[i] - 0.5 * (double)wanted[i]), 1e-7);
    if (!fault.reason) nsvcd_mesh_free(&mesh, NULL);
  }
}

#define PLY_HEAD                                                                  \
  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" \
  "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"

// As people write numbers; what is skipped may be no number.
static void mesh_ply_numbers(void) {
  static const char text[] = PLY_HEAD "1e-3 -0 .5\n-1.E+2 +7 0e999\n\n 1e-999 0.1 3 3 2 1\n0";
  static const float expected[9] = {1e-3f, -0.0f, 0.5f, -100, 7, 0, 0, 0.1f, 3};
  static const char skipped[] =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\n"
      "property float x\nproperty float y\nproperty float z\nproperty list int float w\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "nan 0 0 0 0\n-inf 1 0 0 2 nan inf\n1 0 1 0 0\n3 0 1 2\n";
  nsvcd_mesh mesh;
  mesh_fault fault;
  if (parse("", text, strlen(text), &mesh, &fault)) {
    CHECK_EQ(mesh.vertex_count, 3);
    CHECK_EQ(memcmp(mesh.positions, expected, sizeof expected), 0);
    CHECK(mesh.indices[0] == 2 && mesh.indices[1] == 1 && mesh.indices[2] == 0);
    nsvcd_mesh_free(&mesh, NULL);
  } else {
    CHECK(!"refused");
  }
  CHECK(parse("", skipped, strlen(skipped), &mesh, &fault));
  if (!fault.reason) nsvcd_mesh_free(&mesh, NULL);
}

static void mesh_ply_in_any_locale(void) {
  static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"};
  size_t i = 0;
  while (i < sizeof names / sizeof *names && !setlocale(LC_ALL, names[i])) i++;
  printf("decimal point: '%s'\n", localeconv()->decimal_point);
  mesh_ply_numbers();
  setlocale(LC_ALL, "C");
}

static void mesh_ply_is_refused(void) {
#define PLY_BEGIN "ply\nformat ascii 1.0\n"
#define PLY_VERTICES "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_FACES "element face 1\nproperty list char int vertex_indices\nend_header\n"
#define PLY_THREE "0 0 0\n1 0 0\n0 1 0\n"
#define PLY_GOOD PLY_BEGIN PLY_VERTICES PLY_FACES PLY_THREE
  static const struct {
    const char *text;
    size_t line;
    const char *reason;
  } cases[] = {
      {"ply\n", 1, "its header has no end"},
      {PLY_BEGIN PLY_VERTICES "element face 1\nproperty list char int vertex_indices\n", 8,
       "its header has no end"},
      {PLY_BEGIN PLY_VERTICES "element face 1\nproperty list char int vertex_indices\nend_heade", 9,
       "no line of a PLY header"},
      {"ply\nend_header\n", 2, "names no format"},
      {PLY_BEGIN "end_header\n", 3, "names no format"},
      {"ply\nformat utf8 1.0\n", 2, "neither ascii nor binary"},
      {"ply\nformat\n", 2, "no line of a PLY header"},
      {PLY_BEGIN "element vertex -3\n", 3, "a count of elements"},
      {PLY_BEGIN "element vertex 99999999999\n", 3, "a count of elements"},
      {PLY_BEGIN "element vertex 21474836470\n", 3, "a count of elements"},
      {PLY_BEGIN "element vertex 3.0\n", 3, "a count of elements"},
      {PLY_BEGIN "element vertex\n", 3, "expected: element NAME COUNT"},
      {PLY_BEGIN "element vertex 3\nproperty quad x\n", 4, "no type that PLY has"},
      {PLY_BEGIN "element vertex 3\nproperty float\n", 4, "no type that PLY has"},
      {PLY_BEGIN "element vertex 3\nproperty\n", 4, "no type that PLY has"},
      {PLY_BEGIN "element vertex 3\nproperty list quad int x\n", 4, "no type that PLY has"},
      {PLY_BEGIN "property float x\n", 3, "no line of a PLY header"},
      {PLY_BEGIN "element vertex 3\nproperty float x\nproperty float y\nend_header\n" PLY_THREE, 7,
       "no x, y and z"},
      {PLY_BEGIN PLY_VERTICES "end_header\n" PLY_THREE, 0, "a cloud of points"},
      {PLY_BEGIN PLY_VERTICES PLY_FACES PLY_THREE, 13, "ends before its elements do"},
      {PLY_BEGIN
       "element vertex 2000000000\nproperty char x\nproperty char y\nproperty char z\n" PLY_FACES
           PLY_THREE,
       13, "ends before its elements do"},
      {PLY_GOOD "2 0 1\n", 13, "fewer than three corners"},
      {PLY_GOOD "0\n", 13, "fewer than three corners"},
      {PLY_GOOD "-3 0 1 2\n", 13, "a list of less than no length"},
      {PLY_GOOD "3 0 1\n", 14, "ends before its elements do"},
      {PLY_GOOD "3 0 1 -1\n", 13, "no number of a vertex"},
      {PLY_GOOD "3 0 1 0.5\n", 13, "no number of a vertex"},
      {PLY_GOOD "3 0 1 5e9\n", 13, "no number of a vertex"},
      {PLY_GOOD "3 0 1 x\n", 13, "a number is wanted"},
      {PLY_GOOD "3 0 1-2\n", 13, "a number is wanted"},
      {PLY_GOOD "3 0 1 2e\n", 13, "a number is wanted"},
      {PLY_BEGIN PLY_VERTICES
       "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" PLY_THREE
       "6 0 1 1 -1 2 0\n",
       0, "a cloud of points"},
      {PLY_BEGIN PLY_VERTICES
       "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" PLY_THREE
       "3 0 1 -2\n",
       13, "no number of a vertex"},
      {PLY_GOOD "3 0 1 3\n", 0, "index"},
      {PLY_BEGIN PLY_VERTICES PLY_FACES "0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n", 11,
       "a number is wanted"},
      {PLY_BEGIN PLY_VERTICES PLY_FACES "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", 11,
       "a number is wanted"},
      {PLY_BEGIN PLY_VERTICES PLY_FACES "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", 11,
       "a number is wanted"},
      {PLY_BEGIN PLY_VERTICES PLY_FACES "0 0 0\r1 0 0\r\n\r0 1 x\r3 0 1 2", 13,
       "a number is wanted"},
      {PLY_BEGIN PLY_VERTICES PLY_FACES "0 0 0\n1 1e99 0\n0 1 0\n3 0 1 2\n", 0, "not finite"},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; n++)
    check_refused("", cases[n].text, strlen(cases[n].text), "PLY", cases[n].line, cases[n].reason);
  // binary: the header's lines are named, and no others
  static const double bad[] = {NAN, HUGE_VAL, -HUGE_VAL, 1e39, -1e300};
  for (int n = 0; n < 20; n++) {
    const ply_kinds kinds = {1 + n % 2, 6 + n / 2 % 2, 0, 4, 1, 0, "\n"};
    polygons_random(&shape, 0);
    shape.positions[n % 9] = (float)bad[n / 4];
    ply_write(&file, &shape.faces, &kinds);
    check_refused("", file.at, file.size, "PLY", 0, "not finite");
  }
  const ply_kinds kinds = {1, 6, 0, 4, 1, 0, "\n"};
  polygons_random(&shape, 0);
  ply_write(&file, &shape.faces, &kinds);
  const size_t of_faces = 4 * shape.faces.corner_count + shape.faces.face_count;
  char *first = file.at + file.size - of_faces;
  const char size = *first;
  *first = -1;
  check_refused("", file.at, file.size, "PLY", 0, "a list of less than no length");
  *first = 2;
  check_refused("", file.at, file.size, "PLY", 0, "fewer than three corners");
  *first = size;
  memset(first + 1, 0xff, 4);
  check_refused("", file.at, file.size, "PLY", 0, "no number of a vertex");
  first[4] = 0x7f;
  check_refused("", file.at, file.size, "PLY", 0, "index");
  // more than the reader has room for
  bytes *many = &file;
  many->size = 0;
  put(many, PLY_BEGIN);
  for (int n = 0; n < 17; n++) put(many, "element e%d 0\n", n);
  check_refused("", many->at, many->size, "PLY", 19, "no line of a PLY header");
  many->size = 0;
  put(many, PLY_BEGIN "element vertex 3\n");
  for (int n = 0; n < 65; n++) put(many, "property float p%d\n", n);
  check_refused("", many->at, many->size, "PLY", 68, "more than 64 properties");
}

static void mesh_ply_is_cut_off(void) {
  mesh_rng = 14;
  for (int n = 0; n < 60; n++) {
    ply_kinds kinds = ply_random(1);
    kinds.extras &= 31;
    polygons_random(&shape, 1);
    ply_write(&file, &shape.faces, &kinds);
    // of a text the last number may be shorter, and the last blanks may not be there
    check_prefixes("", &file, kinds.format == 0 ? file.size - 6 : file.size);
  }
}

// --------------------------------------------------------------------------------------------- GLB

#define GLB_VIEW(at, length) "{\"buffer\":0,\"byteOffset\":" #at ",\"byteLength\":" #length "},"
#define GLB_VIEWS \
  "\"buffers\":[{\"byteLength\":408}],\"bufferViews\":[" GLB_VIEW(0, 48) GLB_VIEW(48, 12)     \
      GLB_VIEW(60, 24) GLB_VIEW(84, 48)                                                       \
          "{\"buffer\":0,\"byteOffset\":132,\"byteLength\":80,\"byteStride\":20},"            \
          "{\"buffer\":0,\"byteOffset\":212,\"byteLength\":32,\"byteStride\":8}," GLB_VIEW(   \
              244, 144) "{\"buffer\":0,\"byteOffset\":388,\"byteLength\":11}],"
#define GLB_ROWS(view, kind, type, count, more)                            \
  "{\"bufferView\":" #view ",\"componentType\":" #kind ",\"type\":\"" type \
  "\",\"count\":" #count more "}"
// 0: places; 1 to 3: indices of a byte, two, four; 4: places with a stride; 5: whole numbers that
// mean shares of 1; 6: places of each triangle's corners; 7: a strip; 8: a fan; 9: an index too
// many; 10: as 5, without signs
#define GLB_ACCESSORS \
  "\"accessors\":[" GLB_ROWS(0, 5126, "VEC3", 4, "") "," GLB_ROWS(1, 5121, "SCALAR", 12, "") "," \
  GLB_ROWS(2, 5123, "SCALAR", 12, "") "," GLB_ROWS(3, 5125, "SCALAR", 12, "") "," \
  GLB_ROWS(4, 5126, "VEC3", 4, ",\"byteOffset\":8") "," \
  GLB_ROWS(5, 5122, "VEC3", 4, ",\"normalized\":true") "," GLB_ROWS(6, 5126, "VEC3", 12, "") "," \
  GLB_ROWS(7, 5121, "SCALAR", 6, "") "," GLB_ROWS(7, 5121, "SCALAR", 5, ",\"byteOffset\":6") "," \
  GLB_ROWS(0, 5121, "SCALAR", 3, ",\"byteOffset\":13") "," GLB_ROWS(5, 5123, "VEC3", 4, ",\"normalized\":true") "],"
#define GLB_DATA "{\"asset\":{\"version\":\"2.0\"}," GLB_VIEWS GLB_ACCESSORS
#define GLB_DRAW(position, more) "{\"attributes\":{\"POSITION\":" #position "}" more "}"
#define GLB_MESH(parts) "{\"primitives\":[" parts "]}"
#define GLB_ONE "\"meshes\":[" GLB_MESH(GLB_DRAW(0, ",\"indices\":1")) "],"
#define GLB_SCENE "\"scenes\":[{\"nodes\":[0]}],"
#define GLB_NODES(nodes) "\"nodes\":[" nodes "]}"
#define GLB_GOOD GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0}")

// A tetrahedron of 1, 2 and 3, in all ways that GLB_ACCESSORS names.
static size_t glb_bin(char *out) {
  static const float places[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  static const int corners[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  static const int strip[11] = {0, 2, 1, 3, 0, 2, 0, 1, 3, 2, 1};
  static bytes b;
  b.size = 0;
  for (int i = 0; i < 12; i++) put_float(&b, (double)places[i / 3][i % 3], 0);
  for (size_t width = 1; width <= 4; width *= 2)
    for (int i = 0; i < 12; i++) put_word(&b, (uint64_t)corners[i], width, 0);
  for (int i = 0; i < 4; i++) {
    put_word(&b, UINT64_C(0xffffffffffffffff), 8, 0);
    for (int k = 0; k < 3; k++) put_float(&b, (double)places[i][k], 0);
  }
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < 3; k++)
      put_word(&b, places[i][k] > 0 ? (uint64_t)(k ? -32766 - k : 32767) : 0, 2, 0);
    put_word(&b, 0x7777, 2, 0);
  }
  for (int i = 0; i < 36; i++) put_float(&b, (double)places[corners[i / 3]][i % 3], 0);
  for (int i = 0; i < 11; i++) put_word(&b, (uint64_t)strip[i], 1, 0);
  while (b.size < 408) put_word(&b, 0, 1, 0);
  memcpy(out, b.at, b.size);
  return b.size;
}

// bin: of so many bytes, NULL: no such chunk.
static void glb_write(bytes *out, const char *json, const char *bin, size_t size) {
  const size_t length = (strlen(json) + 3) / 4 * 4;
  out->size = 0;
  put(out, "glTF");
  put_word(out, 2, 4, 0);
  put_word(out, 20 + length + (bin ? 8 + size : 0), 4, 0);
  put_word(out, length, 4, 0);
  put(out, "JSON%-*s", (int)length, json);
  if (!bin) return;
  put_word(out, size, 4, 0);
  put_word(out, 0x004e4942, 4, 0);
  memcpy(out->at + out->size, bin, size);
  out->size += size;
}

static double signed_volume(const nsvcd_mesh *mesh) {
  double sum = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    double c[3][3], v[3];
    mesh_triangle(mesh, t, c, v);
    sum += (c[0][0] * v[0] + c[0][1] * v[1] + c[0][2] * v[2]) / 3;
  }
  return sum;
}

static char glb_binary[512];

// Each way of writing the tetrahedron, and each way of placing it: where it is, and which way round.
static void mesh_glb_is_read(void) {
#define GLB_ONES(position, more) \
  GLB_DATA                       \
  "\"meshes\":[" GLB_MESH(GLB_DRAW(position, more)) "]," GLB_SCENE GLB_NODES("{\"mesh\":0}")
  static const struct {
    const char *json;
    size_t triangles;
    double volume, low[3], high[3];
  } cases[] = {
      {GLB_GOOD, 4, 1, {0, 0, 0}, {1, 2, 3}},
      {GLB_ONES(0, ",\"indices\":2"), 4, 1, {0, 0, 0}, {1, 2, 3}},
      {GLB_ONES(0, ",\"indices\":3,\"mode\":4"), 4, 1, {0, 0, 0}, {1, 2, 3}},
      {GLB_ONES(4, ",\"indices\":1"), 4, 1, {0, 0, 0}, {1, 2, 3}},
      {GLB_ONES(5, ",\"indices\":1"), 4, 1. / 6, {0, -1, -1}, {1, 0, 0}},
      {GLB_ONES(6, ""), 4, 1, {0, 0, 0}, {1, 2, 3}},
      {GLB_ONES(0, ",\"indices\":7,\"mode\":5"), 4, 1, {0, 0, 0}, {1, 2, 3}},
      {GLB_ONES(10, ",\"indices\":1"), 4, 1. / 48, {0, 0, 0}, {0.49999, 0.50002, 0.50001}},
      // the face that a fan from the origin lacks has all of the volume
      {GLB_ONES(0, ",\"indices\":8,\"mode\":6"), 3, 0, {0, 0, 0}, {1, 2, 3}},
      {GLB_DATA
       "\"meshes\":[" GLB_MESH(GLB_DRAW(0, ",\"indices\":8,\"mode\":6")) "]," GLB_SCENE GLB_NODES(
           "{\"mesh\":0,\"translation\":[7,8,9]}"),
       3,
       -14,
       {7, 8, 9},
       {8, 10, 12}},
      // points and lines beside it
      {GLB_DATA "\"meshes\":[" GLB_MESH(
           GLB_DRAW(0, ",\"mode\":0") "," GLB_DRAW(0, ",\"mode\":3") "," GLB_DRAW(
               0, ",\"indices\":1")) "]," GLB_SCENE GLB_NODES("{\"mesh\":0}"),
       4,
       1,
       {0, 0, 0},
       {1, 2, 3}},
      // two primitives; two meshes; one twice
      {GLB_DATA "\"meshes\":[" GLB_MESH(GLB_DRAW(0, ",\"indices\":1") "," GLB_DRAW(
           6, "")) "]," GLB_SCENE GLB_NODES("{\"mesh\":0}"),
       8,
       2,
       {0, 0, 0},
       {1, 2, 3}},
      {GLB_DATA "\"meshes\":[" GLB_MESH(GLB_DRAW(0, ",\"indices\":1")) "," GLB_MESH(GLB_DRAW(
           6, "")) "],\"scenes\":[{\"nodes\":[1,0]}]," GLB_NODES("{\"mesh\":0},"
                                                                 "{\"mesh\":1,\"translation\":[10,"
                                                                 "0,0]}"),
       8,
       2,
       {0, 0, 0},
       {11, 2, 3}},
      {GLB_DATA GLB_ONE
       "\"scenes\":[{\"nodes\":[0]}]," GLB_NODES("{\"children\":[1,2]},"
                                                 "{\"mesh\":0,\"translation\":[0,-5,0]},"
                                                 "{\"mesh\":0}"),
       8,
       2,
       {0, -5, 0},
       {1, 2, 3}},
      // places
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"matrix\":[0,2,0,0,-1,0,0,0,0,0,1,0,"
                                            "7,8,9,1]}"),
       4,
       2,
       {5, 8, 9},
       {7, 10, 12}},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES(
           "{\"mesh\":0,\"translation\":[7,8,9],\"scale\":[2,1,1],"
           "\"rotation\":[0,0,0.7071067811865476,0.7071067811865476]}"),
       4,
       2,
       {5, 8, 9},
       {7, 10, 12}},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"translation\":[7,8,9],\"children\":[2],"
                                            "\"rotation\":[0,0,0.7071067811865476,0."
                                            "7071067811865476]},{},{\"mesh\":0,\"scale\":[2,1,1]}"),
       4,
       2,
       {5, 8, 9},
       {7, 10, 12}},
      // mirrored, and mirrored twice
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"scale\":[-1,1,1]}"),
       4,
       1,
       {-1, 0, 0},
       {0, 2, 3}},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"scale\":[-1,1,1],\"children\":[1]},"
                                            "{\"mesh\":0,\"scale\":[1,-1,1]}"),
       4,
       1,
       {-1, -2, 0},
       {0, 0, 3}},
      {GLB_DATA
       "\"meshes\":[" GLB_MESH(GLB_DRAW(0, ",\"indices\":7,\"mode\":5")) "]," GLB_SCENE GLB_NODES(
           "{\"mesh\":0,\"scale\":[1,1,-1]}"),
       4,
       1,
       {0, 0, -3},
       {1, 2, 0}},
      // the scene that is named, not the first
      {GLB_DATA GLB_ONE "\"scene\":1,\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1]}]," GLB_NODES(
           "{\"mesh\":0},"
           "{\"mesh\":0,\"translation\":[1,1,1]}"),
       4,
       1,
       {1, 1, 1},
       {2, 3, 4}},
      // what is not known is not looked at
      {" {\"a\\\"}\":[[],{},\"\\u00e4\\\\\",true,false,null,-1.5e-3],\"meshes\":[" GLB_MESH(
           GLB_DRAW(6, "")) "]," GLB_SCENE GLB_VIEWS GLB_ACCESSORS
           GLB_NODES("{\"mesh\":0,\"name\":\"{\"}"),
       4,
       1,
       {0, 0, 0},
       {1, 2, 3}},
  };
  const size_t size = glb_bin(glb_binary);
  for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
    nsvcd_mesh mesh;
    mesh_fault fault;
    glb_write(&file, cases[n].json, glb_binary, size);
    if (!parse("", file.at, file.size, &mesh, &fault)) {
      printf("  case %d: %s\n", (int)n, fault.reason);
      CHECK(!"refused");
      continue;
    }
    CHECK_EQ(mesh.triangle_count, cases[n].triangles);
    CHECK_NEAR(signed_volume(&mesh), cases[n].volume, 1e-5);
    for (int k = 0; k < 3; k++) {
      double low = HUGE_VAL;
      double high = -HUGE_VAL;
      for (size_t v = 0; v < mesh.vertex_count; v++) {
        low = fmin(low, (double)mesh.positions[3 * v + (size_t)k]);
        high = fmax(high, (double)mesh.positions[3 * v + (size_t)k]);
      }
      CHECK_NEAR(low, cases[n].low[k], 1e-5);
      CHECK_NEAR(high, cases[n].high[k], 1e-5);
    }
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static void mesh_glb_is_refused(void) {
#define GLB_WITH(accessors) \
  "{" GLB_VIEWS "\"accessors\":[" accessors "]," GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0}")
#define GLB_VIEWED(view) \
  "{\"buffers\":[{}],\"bufferViews\":[" view "],\"accessors\":[" GLB_ROWS(0, 5126, "VEC3", 4, "") "]," \
  "\"meshes\":[" GLB_MESH(GLB_DRAW(0, "")) "]," GLB_SCENE GLB_NODES("{\"mesh\":0}")
#define PLACES GLB_ROWS(0, 5126, "VEC3", 4, "")
#define ENDS_OUTSIDE "ends outside of its data"
#define OFFSET_OUTSIDE "an offset outside of the file"
  static const struct {
    const char *json, *reason;
  } cases[] = {
      {"", "no JSON"},
      {"{", "no JSON"},
      {GLB_GOOD "}", "no JSON"},
      {"{\"a\":1,}", "no JSON"},
      {"{\"a\" 1}", "no JSON"},
      {"{\"a\"}", "no JSON"},
      {"{a:1}", "no JSON"},
      {"{\"a\":+1}", "no JSON"},
      {"{\"a\":nan}", "no JSON"},
      {"[1 2]", "no JSON"},
      {"[\"\n\"]", "no JSON"},
      {"[\"\\", "no JSON"},
      {"[\"a", "no JSON"},
      {"[tru]", "no JSON"},
      {"[]", "no scene"},
      {"7", "no scene"},
      {"{}", "no scene"},
      {GLB_DATA GLB_ONE GLB_NODES("{\"mesh\":0}"), "no scene"},
      {GLB_DATA GLB_ONE "\"scene\":1," GLB_SCENE GLB_NODES("{\"mesh\":0}"), "no scene"},
      {GLB_DATA GLB_ONE "\"scene\":-1," GLB_SCENE GLB_NODES("{\"mesh\":0}"), "no scene"},
      {GLB_DATA GLB_ONE "\"scene\":0.5," GLB_SCENE GLB_NODES("{\"mesh\":0}"), "no scene"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{}"), "no triangles"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES(""), "a node that is not there"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"children\":[9]}"), "a node that is not there"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":1}"), "a mesh that is not there"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"scale\":[1,1]}"), "a broken place"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"scale\":[1,1,1,1]}"), "a broken place"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"scale\":[1,1,null]}"), "a broken place"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"matrix\":3}"), "a broken place"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"scale\":[1e300,1e300,1]}"),
       "not finite"},
      // rings, and what has two parents
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"mesh\":0,\"children\":[0]}"), "named twice"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"children\":[1]},{\"children\":[0],\"mesh\":0}"),
       "named twice"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES("{\"children\":[1,1]},{\"mesh\":0}"), "named twice"},
      {GLB_DATA GLB_ONE "\"scenes\":[{\"nodes\":[0,0]}]," GLB_NODES("{\"mesh\":0}"), "named twice"},
      {GLB_DATA GLB_ONE GLB_SCENE GLB_NODES(
           "{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{}}}"),
       "instances"},
      // primitives
      {GLB_ONES(0, ",\"mode\":7"), "a mode of drawing"},
      {GLB_ONES(0, ",\"mode\":-4"), "a mode of drawing"},
      {GLB_ONES(1, ""), "of another type"},
      {GLB_ONES(99, ""), "not there"},
      {GLB_ONES(0, ",\"indices\":0"), "of another type"},
      {GLB_ONES(0, ",\"indices\":99"), "not there"},
      {GLB_ONES(0, ",\"indices\":9"), "an index beyond the vertices"},
      {GLB_ONES(0, ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0}}"), "Draco"},
      {GLB_DATA "\"meshes\":[{\"primitives\":[{}]}]," GLB_SCENE GLB_NODES("{\"mesh\":0}"),
       "not there"},
      // accessors
      {GLB_WITH("{\"componentType\":5126,\"type\":\"VEC3\",\"count\":4}"),
       "an accessor without data"},
      {GLB_WITH(GLB_ROWS(9, 5126, "VEC3", 4, "")), "an accessor without data"},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 4, ",\"sparse\":{\"count\":1}")), "sparse"},
      {GLB_WITH(GLB_ROWS(0, 5124, "VEC3", 4, "")), "a type of numbers"},
      {GLB_WITH(GLB_ROWS(0, 5130, "VEC3", 4, "")), "a type of numbers"},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 5, "")), ENDS_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 0, "")), ENDS_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", -1, "")), ENDS_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 1537228672809129302, "")), ENDS_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 4, ",\"byteOffset\":4")), ENDS_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 4, ",\"byteOffset\":49")), OFFSET_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 4, ",\"byteOffset\":-4")), OFFSET_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 4, ",\"byteOffset\":9007199254740992")), OFFSET_OUTSIDE},
      {GLB_WITH(GLB_ROWS(0, 5126, "VEC3", 3, "") "," GLB_ROWS(1, 5121, "SCALAR", 12, "")),
       "an index beyond the vertices"},
      // indices are whole, and not less than none
      {GLB_WITH(PLACES "," GLB_ROWS(1, 5120, "SCALAR", 12, "")), "indices of a type"},
      {GLB_WITH(PLACES "," GLB_ROWS(2, 5122, "SCALAR", 12, "")), "indices of a type"},
      {GLB_WITH(PLACES "," GLB_ROWS(3, 5126, "SCALAR", 12, "")), "indices of a type"},
      {GLB_WITH(PLACES "," GLB_ROWS(1, 5121, "SCALAR", 12, ",\"normalized\":true")),
       "indices of a type"},
      // views
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":48,\"byteOffset\":361}"), OFFSET_OUTSIDE},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":409}"), OFFSET_OUTSIDE},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":-1}"), OFFSET_OUTSIDE},
      {GLB_VIEWED("{\"buffer\":0}"), ENDS_OUTSIDE},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":47}"), ENDS_OUTSIDE},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":408,\"byteStride\":11}"), "a stride"},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":408,\"byteStride\":0}"), "a stride"},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":408,\"byteStride\":133}"), ENDS_OUTSIDE},
      {GLB_VIEWED("{\"buffer\":0,\"byteLength\":408,\"byteStride\":9007199254740992}"), "a stride"},
      {GLB_VIEWED("{\"buffer\":1,\"byteLength\":48}"), "in another file"},
      {GLB_VIEWED("{\"byteLength\":48}"), "in another file"},
      {GLB_VIEWED(
           "{\"buffer\":0,\"byteLength\":48,\"extensions\":{\"EXT_meshopt_compression\":{}}}"),
       "meshopt"},
      {GLB_VIEWED(
           "{\"buffer\":0,\"byteLength\":48,\"extensions\":{\"KHR_meshopt_compression\":{}}}"),
       "meshopt"},
  };
  const size_t size = glb_bin(glb_binary);
  for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
    glb_write(&file, cases[n].json, glb_binary, size);
    check_refused("", file.at, file.size, "GLB", 0, cases[n].reason);
  }
  // nodes below nodes
  static bytes json;
  json.size = 0;
  put(&json, GLB_DATA GLB_ONE GLB_SCENE "\"nodes\":[");
  for (int n = 0; n < 200; n++) put(&json, "{\"children\":[%d]},", n + 1);
  put(&json, "{\"mesh\":0}]}");
  glb_write(&file, json.at, glb_binary, size);
  check_refused("", file.at, file.size, "GLB", 0, "more than 64 deep");
  // brackets in brackets
  for (int deep = 60; deep <= 70; deep += 10) {
    json.size = 0;
    for (int n = 0; n < 2 * deep; n++) put(&json, n < deep ? "[" : "]");
    glb_write(&file, json.at, glb_binary, size);
    check_refused("", file.at, file.size, "GLB", 0, deep < 65 ? "no scene" : "no JSON");
  }
  // another file's data, whether there is a chunk or not
  static const char outside[] =
      "{\"buffers\":[{\"byteLength\":408,\"uri\":\"a.bin\"}],\"bufferViews\":["
      "{\"buffer\":0,\"byteLength\":408}]," GLB_ACCESSORS GLB_ONE GLB_SCENE GLB_NODES(
          "{\"mesh\":0}");
  glb_write(&file, outside, glb_binary, size);
  check_refused("", file.at, file.size, "GLB", 0, "in another file");
  glb_write(&file, outside, NULL, 0);
  check_refused("", file.at, file.size, "GLB", 0, "in another file");
  glb_write(&file, GLB_GOOD, NULL, 0);
  check_refused("", file.at, file.size, "GLB", 0, OFFSET_OUTSIDE);
}

static void mesh_glb_chunks(void) {
  static const struct {
    int at;
    unsigned word;
    const char *reason;
  } cases[] = {
      {4, 1, "version 2"},
      {4, 3, "version 2"},
      {8, 19, "shorter"},
      {8, 0xffffffffu, "shorter"},
      {8, 60, "a chunk that ends"},
      {12, 0xffffffffu, "a chunk that ends"},
      {12, 0, "no JSON"},
      {12, 0xfffffff8u, "a chunk that ends"},
      {16, 0x004e4942u, "chunks that are not"},
  };
  const size_t size = glb_bin(glb_binary);
  for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
    glb_write(&file, GLB_GOOD, glb_binary, size);
    for (int k = 0; k < 4; k++) file.at[cases[n].at + k] = (char)(cases[n].word >> 8 * k & 255);
    check_refused("", file.at, file.size, "GLB", 0, cases[n].reason);
  }
  glb_write(&file, GLB_GOOD, glb_binary, size);
  file.at[20 + (strlen(GLB_GOOD) + 3) / 4 * 4] += 4;  // the second chunk's length
  check_refused("", file.at, file.size, "GLB", 0, "a chunk that ends");
  glb_write(&file, GLB_GOOD, glb_binary, size);
  check_prefixes("a.glb", &file, file.size);
  file.at[0] = 'G';
  check_refused("a.glb", file.at, file.size, "GLB", 0, "does not begin with 'glTF'");
  // what is not of the file by its own length is not looked at
  glb_write(&file, GLB_GOOD, glb_binary, size);
  put(&file, "more");
  nsvcd_mesh mesh;
  mesh_fault fault;
  CHECK(parse("", file.at, file.size, &mesh, &fault));
  if (!fault.reason) nsvcd_mesh_free(&mesh, NULL);
}

// Small files that ask for much: one mesh of many nodes, of many primitives, or of many other values.
static void mesh_glb_asks_for_much(void) {
  static const char *const parts[] = {"{\"mode\":0},", GLB_DRAW(6, "") ",",
                                      GLB_DRAW(0, ",\"mode\":0") ","};
  static bytes json;
  const size_t size = glb_bin(glb_binary);
  for (size_t n = 0; n < sizeof parts / sizeof *parts; n++) {
    int nodes = 0;
    json.size = 0;
    put(&json, GLB_DATA "\"meshes\":[{\"primitives\":[");
    while (json.size < 200000) put(&json, "%s", parts[n]);
    put(&json, GLB_DRAW(6, "") "]}],\"nodes\":[");
    for (; json.size < 400000; nodes++) put(&json, "{\"mesh\":0},");
    put(&json, "{}],\"scenes\":[{\"nodes\":[");
    for (int k = 0; k < nodes; k++) put(&json, "%d,", k);
    put(&json, "%d]}]}", nodes);
    glb_write(&file, json.at, glb_binary, size);
    check_refused("", file.at, file.size, "GLB", 0, "many times");
  }
  // a strip of a byte a triangle, of three corners each
  json.size = 0;
  put(&json, "{\"accessors\":[" GLB_ROWS(0, 5126, "VEC3", 3, "") ","
             GLB_ROWS(1, 5121, "SCALAR", 500000, "") "],\"bufferViews\":["
             GLB_VIEW(0, 36) "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":500000}],"
             "\"buffers\":[{}],\"meshes\":[" GLB_MESH(GLB_DRAW(0, ",\"indices\":1,\"mode\":5"))
             "],\"nodes\":[");
  for (int k = 0; k < 28; k++) put(&json, "{\"mesh\":0},");
  put(&json, "{}],\"scenes\":[{\"nodes\":[0");
  for (int k = 1; k < 28; k++) put(&json, ",%d", k);
  put(&json, "]}]}");
  static char strip[500036];
  glb_write(&file, json.at, strip, sizeof strip);
  check_refused("", file.at, file.size, "GLB", 0, "many times");
  // and one that is well: 3,000 nodes of one mesh
  json.size = 0;
  put(&json, GLB_DATA GLB_ONE "\"nodes\":[");
  for (int k = 0; k < 3000; k++) put(&json, "{\"mesh\":0},");
  put(&json, "{}],\"scenes\":[{\"nodes\":[0");
  for (int k = 1; k < 3000; k++) put(&json, ",%d", k);
  put(&json, "]}]}");
  glb_write(&file, json.at, glb_binary, size);
  nsvcd_mesh mesh;
  mesh_fault fault;
  CHECK(parse("", file.at, file.size, &mesh, &fault));
  if (fault.reason) return;
  CHECK_EQ(mesh.triangle_count, 12000);
  nsvcd_mesh_free(&mesh, NULL);
}

// --------------------------------------------------------------------------------- STL, and a choice

static void stl_write(bytes *out, const char *title, uint32_t triangles, uint32_t told) {
  out->size = 0;
  put(out, "%-80s", title);
  put_word(out, told, 4, 0);
  for (uint32_t t = 0; t < triangles; t++) {
    for (int k = 0; k < 12; k++) put_float(out, k == 3 || k == 7 ? 1 : (double)t, 0);
    put_word(out, 0, 2, 0);
  }
}

static void mesh_stl_reasons(void) {
  static const char text[] =
      "solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 x 0\nendloop\n";
  nsvcd_mesh mesh;
  mesh_fault fault;
  static const char *const titles[] = {"made by hand", "solid by hand"};
  for (int n = 0; n < 2; n++) {
    stl_write(&file, titles[n], 5, 5);
    CHECK(parse("", file.at, file.size, &mesh, &fault));
    CHECK_EQ(strcmp(fault.format, "STL"), 0);
    if (!fault.reason) CHECK_EQ(mesh.triangle_count, 5);
    if (!fault.reason) nsvcd_mesh_free(&mesh, NULL);
  }
  // a count that lies
  stl_write(&file, "made by hand", 5, 6);
  check_refused("a.stl", file.at, file.size, "STL", 0, "shorter than its count");
  stl_write(&file, "made by hand", 5, 4);
  check_refused("a.stl", file.at, file.size, "STL", 0, "longer than its count");
  stl_write(&file, "made by hand", 5, 0xffffffffu);
  check_refused("a.stl", file.at, file.size, "STL", 0, "shorter than its count");
  stl_write(&file, "made by hand", 0, 0);
  check_refused("a.stl", file.at, file.size, "STL", 0, "no triangle");
  // a few bytes behind the last triangle do no harm
  stl_write(&file, "made by hand", 5, 5);
  file.size += 10;
  CHECK(parse("a.stl", file.at, file.size, &mesh, &fault));
  if (!fault.reason) nsvcd_mesh_free(&mesh, NULL);
  // binary that begins as text does
  stl_write(&file, "solid by hand", 5, 6);
  check_refused("a.stl", file.at, file.size, "STL", 0, "shorter than its count");
  stl_write(&file, "solid by hand", 5, 4);
  check_refused("a.stl", file.at, file.size, "STL", 0, "longer than its count");
  // text that does not
  check_refused("a.stl", text + 8, strlen(text) - 8, "STL", 0, "text begins with 'solid'");
  check_refused("a.stl", text, strlen(text), "STL", 5, "");
  check_refused("a.stl", "solid a\nendsolid a\n", 19, "STL", 0, "no triangle");
}

static void mesh_files_are_told_apart(void) {
  static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  static const char ply[] = PLY_GOOD "3 0 1 2\n";
  static const char stl[] = "solid a\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n";
  static const char *const names[] = {"",      "a",         "a.obj",     "a.OBJ", "a.txt", "a.b/c",
                                      "a.ply", "a.b.c.stl", "a.longer.", ".glb",  "a.Stl", "a.PLY"};
  // of each name: what is read of OBJ, PLY and text STL; G: said to be a GLB, and so on
  static const char *const expected[] = {"OPS", "OPS", "OPO", "OPO", "OPS", "OPS",
                                         "PPP", "SPS", "OPS", "GPG", "SPS", "PPP"};
  static const char *const files[3] = {obj, ply, stl};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    for (size_t k = 0; k < 3; k++) {
      nsvcd_mesh mesh;
      mesh_fault fault;
      const int good = parse(names[n], files[k], strlen(files[k]), &mesh, &fault);
      CHECK_EQ(fault.format[0], expected[n][k]);
      CHECK_EQ(good, expected[n][k] == "OPS"[k]);
      if (good) CHECK_EQ(mesh.triangle_count, 1);
      if (good) nsvcd_mesh_free(&mesh, NULL);
    }
  }
  glb_write(&file, GLB_GOOD, glb_binary, glb_bin(glb_binary));
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    nsvcd_mesh mesh;
    mesh_fault fault;
    CHECK(parse(names[n], file.at, file.size, &mesh, &fault));
    CHECK_EQ(fault.format[0], 'G');
    if (!fault.reason) nsvcd_mesh_free(&mesh, NULL);
  }
  check_refused("a.DAZ.DAE", obj, strlen(obj), "none of these", 0, "convert it");
  check_refused("a.fbx", obj, strlen(obj), "none of these", 0, "convert it");
  check_refused("a.OFF", "OFF\n3 1 0\n", 10, "none of these", 0, "convert it");
  check_refused("a.b.GLTF", "{}", 2, "none of these", 0, "convert it");
  check_refused("a.ply", obj, strlen(obj), "PLY", 0, "does not begin with 'ply'");
  check_refused("a.glb", "", 0, "GLB", 0, "does not begin with 'glTF'");
  check_refused("", "", 0, "OBJ", 0, "no triangle");
  check_refused("", "f 1 2\n", 6, "OBJ", 1, "");
}

// Whichever allocation fails, of the readers or of the library: refused, and all is given back.
static void mesh_files_without_memory(void) {
  static const char text[] = PLY_GOOD "3 0 1 2\n";
  failing_heap heap = {0, 0, -1};
  const nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, &heap};
  glb_write(&file, GLB_GOOD, glb_binary, glb_bin(glb_binary));
  for (int n = 0; n < 4; n++) {
    const char *data = n % 2 ? file.at : text;
    const size_t size = n % 2 ? file.size : sizeof text - 1;
    int good = 0;
    int k = 0;
    for (; !good; k++) {
      nsvcd_mesh mesh = {NULL, NULL, 7, 7};
      mesh_fault fault;
      files_taken = heap.calls = 0;
      files_fail_at = n < 2 ? k : -1;
      heap.fail_at = n < 2 ? -1 : k;
      good = mesh_parse("", data, size, &allocator, &mesh, &fault);
      CHECK(good == !fault.reason && (good || mesh.vertex_count == 7));
      CHECK(good || n < 2 || strstr(fault.reason, "memory"));
      if (good) nsvcd_mesh_free(&mesh, &allocator);
      CHECK(heap.live == 0 && files_live == 0);
    }
    CHECK_GE(k, 5);
  }
  files_fail_at = -1;
}

void test_mesh_files(void) {
  RUN(mesh_of_faces_is_that_of_obj);
  RUN(mesh_of_faces_refuses);
  RUN(mesh_ply_is_read);
  RUN(mesh_ply_strips);
  RUN(mesh_files_become_metres_in_double);
  RUN(mesh_ply_numbers);
  RUN(mesh_ply_in_any_locale);
  RUN(mesh_ply_is_refused);
  RUN(mesh_ply_is_cut_off);
  RUN(mesh_glb_is_read);
  RUN(mesh_glb_is_refused);
  RUN(mesh_glb_chunks);
  RUN(mesh_glb_asks_for_much);
  RUN(mesh_stl_reasons);
  RUN(mesh_files_are_told_apart);
  RUN(mesh_files_without_memory);
}

CHECK_ALONE(test_mesh_files)
