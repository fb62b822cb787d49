// PLY. What is accepted of binary files is counted a second time, by their headers.
#define FUZZ_TARGET "ply"
#define FUZZ_TOKENS                                                                              \
  "ply\n", "format ascii 1.0\n", "format binary_little_endian 1.0\n",                             \
      "format binary_big_endian 1.0\n", "comment a\n", "element vertex 3\n", "element face 1\n",  \
      "element edge 2\n", "element vertex 0\n", "property float x\n", "property double y\n",      \
      "property char z\n", "property uint8 a\n", "property list uchar int vertex_indices\n",      \
      "property list char ushort vertex_index\n", "property list int8 float b\n", "end_header\n", \
      "\r\n", "\r", "3 ", "0 ", "1 ", "2 ", "-1 ", "1e-3 ", ".5 ", "1e99 ", "nan ", "3 0 1 2\n",  \
      "4 0 1 2 3\n", "0 0 0\n", "4294967296 ", "2147483647 ", "short ", "int32 ", "float64 ",
#include "main.h"

#include "files.h"

enum { PROPERTIES = 64, ELEMENTS = 16 };

typedef struct property {
  char length, type;  // letters, as below; 0: no list
  int is_corners;
} property;
typedef struct element {
  property properties[PROPERTIES];
  size_t properties_count;
  size_t count;
  int is_vertex, is_face;
} element;

// i8 u8 i16 u16 i32 u32 f32 f64 as a letter each.
static char letter(const char *name) {
  static const char *const names[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  static const char *const others[] = {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  for (int k = 0; k < 8; k++) {
    if (strcmp(name, names[k]) == 0 || strcmp(name, others[k]) == 0)
      return "bBhHiIfd"[k];
  }
  return 0;
}

static size_t width(char type) {
  static const char letters[] = "bBhHiIfd";
  return (size_t)1 << (strchr(letters, type) - letters) / 2 >> (type == 'f');
}

static double value_of(const uint8_t *at, char type, int big) {
  const uint64_t word = mesh_word(at, width(type), big);
  const uint32_t half = (uint32_t)word;
  float narrow;
  double wide;
  memcpy(&narrow, &half, sizeof narrow);
  memcpy(&wide, &word, sizeof wide);
  switch (type) {
    case 'b': return (int8_t)word;
    case 'h': return (int16_t)word;
    case 'i': return (int32_t)word;
    case 'f': return (double)narrow;
    case 'd': return wide;
    default: return (double)word;
  }
}

static element elements[ELEMENTS];

// Reads the header, of lines that end in LF or CR LF. Returns the place behind it; 0: not one to count.
static size_t read_header(const uint8_t *data, size_t size, size_t *count, int *big) {
  size_t at = 0;
  int is_binary = 0;
  *count = 0;
  while (at < size) {
    char line[200], a[200], b[200], c[200], d[200];
    size_t length = 0;
    while (at + length < size && data[at + length] != '\n')
      length++;
    if (length >= sizeof line || memchr(data + at, 0, length))
      return 0;
    memcpy(line, data + at, length);
    line[length] = 0;
    at += length + 1;
    if (length > 0 && line[length - 1] == '\r')
      line[--length] = 0;
    if (strpbrk(line, "\r\v\f"))
      return 0;
    const int words = sscanf(line, "%199s %199s %199s %199s", a, b, c, d);
    element *now = *count ? &elements[*count - 1] : NULL;
    if (words >= 1 && strcmp(a, "end_header") == 0)
      return is_binary ? at : 0;
    if (words >= 2 && strcmp(a, "format") == 0) {
      is_binary = strcmp(b, "ascii") != 0;
      *big = strcmp(b, "binary_big_endian") == 0;
    } else if (words == 3 && strcmp(a, "element") == 0 && *count < ELEMENTS) {
      now = &elements[(*count)++];
      memset(now, 0, sizeof *now);
      now->count = (size_t)strtoull(c, NULL, 10);
      now->is_vertex = strcmp(b, "vertex") == 0;
      now->is_face = strcmp(b, "face") == 0;
    } else if (words >= 3 && strcmp(a, "property") == 0 && now &&
               now->properties_count < PROPERTIES) {
      property *p = &now->properties[now->properties_count++];
      const int is_list = words == 4 && strcmp(b, "list") == 0;
      p->type = letter(is_list ? d : b);
      p->length = is_list ? letter(c) : 0;
      const char *name = strrchr(line, ' ');
      if (!p->type || !name || strchr(line, '\t') || name[1] == 0)
        return 0;
      p->is_corners = strcmp(name, " vertex_index") == 0 || strcmp(name, " vertex_indices") == 0;
    }
  }
  return 0;
}

static void check_counts(const uint8_t *data, size_t size, const nsvcd_mesh *mesh) {
  size_t count;
  size_t vertices = 0;
  size_t triangles = 0;
  int big = 0;
  size_t at = read_header(data, size, &count, &big);
  if (at == 0)
    return;
  for (size_t e = 0; e < count; e++) {
    for (size_t row = 0; row < elements[e].count && elements[e].properties_count; row++) {
      for (size_t k = 0; k < elements[e].properties_count; k++) {
        const property *p = &elements[e].properties[k];
        size_t length = 1;
        if (p->length) {
          FUZZ_CHECK(at + width(p->length) <= size);
          length = (size_t)value_of(data + at, p->length, big);
          at += width(p->length);
          triangles += elements[e].is_face && p->is_corners ? length - 2 : 0;
        }
        FUZZ_CHECK(length * width(p->type) <= size - at);
        at += length * width(p->type);
      }
      vertices += (size_t)elements[e].is_vertex;
    }
  }
  FUZZ_CHECK(vertices == mesh->vertex_count);
  FUZZ_CHECK(triangles == mesh->triangle_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  nsvcd_mesh mesh;
  mesh_fault fault;
  if (!files_take("a.ply", data, size, &mesh, &fault))
    return 0;
  if (fault.format[0] == 'P')
    check_counts(data, size, &mesh);
  nsvcd_mesh_free(&mesh, NULL);
  return 0;
}
