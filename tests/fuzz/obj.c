// OBJ text. What is accepted is read a second time here, as nsvcd_obj_parse is described: the same
// numbers of vertices and triangles, the same vertices, and of each face the same corners.
#define FUZZ_TARGET "obj"
#define FUZZ_TOKENS                                                                               \
  "v 0 0 0\n", "v 1 0 0\n", "v 0 1 0\n", "f 1 2 3\n", "f 1 2 3 4\n", "f -1 -2 -3\n", "f 1/2/3",   \
      " 1//2", " # ", "#\n", "\\\n", "\\\r\n", "\r\n", "\r", "\n", "\\", " \\\n", "v", "f", "g ", \
      "\t", " ", "e-5", "1e38", ".5", "nan", "-0", "vn 0 0 1\n", "usemtl a\n", "\xef\xbb\xbf",    \
      "4294967296", "2147483648", "99999999999999999999", "\v", "# x \\\n", " 1 0.25 -3",         \
      "solid\n", "vertex 0 0 1\n", "vertex 1 0 0\n", "endloop\n",
#include "main.h"

#include "../../neuralsvcd.h"
#include "../failing_heap.h"

// ------------------------------------------------------------------------------- the second reading

typedef struct text {
  const char *at, *end;
} text;

typedef struct token {
  const char *at;
  size_t length;
} token;

// Length of the end of a line at p: LF, CR or CR LF.
static size_t newline_at(const text *t, const char *p) {
  const size_t left = (size_t)(t->end - p);
  if (left >= 2 && memcmp(p, "\r\n", 2) == 0)
    return 2;
  return left >= 1 && (*p == '\n' || *p == '\r');
}

// Length of what parts two tokens of a statement at p.
static size_t gap_at(const text *t, const char *p) {
  const size_t left = (size_t)(t->end - p);
  if (left >= 1 && strchr(" \t\v\f", *p) && *p)
    return 1;
  const size_t newline = left >= 2 && *p == '\\' ? newline_at(t, p + 1) : 0;
  return newline ? 1 + newline : 0;
}

// The next token of a statement; 0 where it has no more: then the next statement follows. A comment
// ends with its line, whatever stands at the end of that.
static int next_token(text *t, token *out) {
  for (size_t gap = gap_at(t, t->at); gap > 0; gap = gap_at(t, t->at))
    t->at += gap;
  if (t->at < t->end && *t->at == '#') {
    while (t->at < t->end && newline_at(t, t->at) == 0)
      t->at++;
  }
  if (t->at == t->end)
    return 0;
  const size_t newline = newline_at(t, t->at);
  t->at += newline;
  if (newline > 0)
    return 0;
  out->at = t->at;
  while (t->at < t->end && newline_at(t, t->at) == 0 && gap_at(t, t->at) == 0)
    t->at++;
  out->length = (size_t)(t->at - out->at);
  return 1;
}

static int is_word(token t, const char *word) {
  return t.length == strlen(word) && memcmp(t.at, word, t.length) == 0;
}

// A number that is too long to be copied: 0, and *known is 0.
static double value_of(token t, int *known) {
  char copy[80];
  *known = t.length < sizeof copy;
  if (!*known)
    return 0;
  memcpy(copy, t.at, t.length);
  copy[t.length] = 0;
  return strtod(copy, NULL);
}

static void check_vertex(text *t, const float *position) {
  token number;
  for (size_t k = 0; next_token(t, &number); k++) {
    int known;
    const double value = value_of(number, &known);
    if (k >= 3 || !known)
      continue;
    const float low = nextafterf((float)value, -HUGE_VALF);
    const float high = nextafterf((float)value, HUGE_VALF);
    FUZZ_CHECK(position[k] >= low && position[k] <= high);
    FUZZ_CHECK(fabsf(position[k]) <= 1e6f);
  }
}

// Are the corners of these triangles corners of the face, `vertices` of them before it?
static size_t check_face(text *t, size_t vertices, const uint32_t *triangles, size_t most) {
  static uint32_t corners[FUZZ_MOST];
  size_t count = 0;
  token corner;
  for (; next_token(t, &corner); count++) {
    int known;
    const double number = value_of(corner, &known);
    const double from = number < 0 ? (double)vertices : -1;
    FUZZ_CHECK(count < FUZZ_MOST);
    corners[count] = known ? (uint32_t)(from + number) : 0xffffffffu;
  }
  FUZZ_CHECK(count >= 3 && count - 2 <= most);
  for (size_t k = 0; k < 3 * (count - 2); k++) {
    size_t c = 0;
    while (c < count && corners[c] != triangles[k] && corners[c] != 0xffffffffu)
      c++;
    FUZZ_CHECK(c < count);
    FUZZ_CHECK(count > 3 || corners[k] == triangles[k] || corners[k] == 0xffffffffu);
  }
  return count - 2;
}

static void check_mesh(const char *data, size_t size, const nsvcd_mesh *mesh) {
  text t = {data, data + size};
  size_t vertices = 0;
  size_t triangles = 0;
  if (size >= 3 && memcmp(data, "\xef\xbb\xbf", 3) == 0)
    t.at += 3;
  while (t.at < t.end) {
    token word;
    if (!next_token(&t, &word))
      continue;
    if (is_word(word, "v")) {
      FUZZ_CHECK(vertices < mesh->vertex_count);
      check_vertex(&t, mesh->positions + 3 * vertices++);
    } else if (is_word(word, "f")) {
      FUZZ_CHECK(triangles < mesh->triangle_count);
      triangles +=
          check_face(&t, vertices, mesh->indices + 3 * triangles, mesh->triangle_count - triangles);
    } else {
      while (next_token(&t, &word)) {
      }
    }
  }
  FUZZ_CHECK(vertices == mesh->vertex_count);
  FUZZ_CHECK(triangles == mesh->triangle_count);
  for (size_t k = 0; k < 3 * triangles; k++)
    FUZZ_CHECK(mesh->indices[k] < vertices);
}

// ------------------------------------------------------------------------------------------ the ask

// With the allocation of this number failing, -1 for none. Returns how many were made.
static int parse(const char *data, size_t size, int fail_at, nsvcd_result *result) {
  failing_heap heap = {0, 0, 0};
  nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
  nsvcd_mesh mesh = {NULL, NULL, 7, 7};
  size_t line = 999;
  const text all = {data, data + size};
  size_t lines = 1;
  heap.fail_at = fail_at;
  allocator.user = &heap;
  *result = nsvcd_obj_parse(data, size, &allocator, &mesh, &line);
  for (size_t k = 0; k < size; k++)
    lines += newline_at(&all, data + k) == 1;
  FUZZ_CHECK(line <= lines);
  if (*result) {
    FUZZ_CHECK(!mesh.positions && !mesh.indices);
    FUZZ_CHECK(mesh.vertex_count == 7 && mesh.triangle_count == 7);
  } else {
    check_mesh(data, size, &mesh);
    nsvcd_mesh_free(&mesh, &allocator);
  }
  FUZZ_CHECK(heap.live == 0);
  return heap.calls;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  nsvcd_result result;
  nsvcd_result again;
  const int calls = parse((const char *)data, size, -1, &result);
  fuzz_taken += result == NSVCD_OK;
  for (int k = 0; k < calls && k < 16; k++) {
    parse((const char *)data, size, k, &again);
    FUZZ_CHECK(again == NSVCD_ERROR_MEMORY);
  }
  // the same bytes as STL
  nsvcd_mesh mesh;
  size_t line;
  if (nsvcd_stl_parse(data, size, NULL, &mesh, &line) == NSVCD_OK) {
    for (size_t k = 0; k < 3 * mesh.triangle_count; k++)
      FUZZ_CHECK(mesh.indices[k] < mesh.vertex_count);
    nsvcd_mesh_free(&mesh, NULL);
  }
  return 0;
}
