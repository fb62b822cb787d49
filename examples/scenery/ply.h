// ply.h - a mesh from a PLY file (Turk 1994), text or binary: the vertices' x, y, z, the faces and the
// strips of triangles; all else is skipped. Include neuralsvcd.h first.
#ifndef NSVCD_SCENERY_PLY_H
#define NSVCD_SCENERY_PLY_H

#include "mesh_soup.h"

#define PLY_PROPERTIES 64  // the most of an element
#define PLY_NO_MEMORY "out of memory"

typedef enum ply_kind { PLY_INTEGER, PLY_UNSIGNED, PLY_REAL } ply_kind;

typedef struct ply_type {
  ply_kind kind;
  size_t bytes;  // 0: none
} ply_type;

typedef struct ply_property {
  ply_type type;
  ply_type length;  // the type of a list's length
  int part;         // 0 to 2: x, y, z of a vertex; 3: corners of a face, 4: of a strip; -1: skipped
} ply_property;

typedef struct ply_reader {
  const char *at, *end;
  size_t line;
  int is_text, is_big;
  int ends_in_cr;  // alone: the first row of what is binary may begin with a byte that is LF
  mesh_soup *soup;
  mesh_fault *fault;
} ply_reader;

// A word of the header's text.
typedef struct ply_word {
  const char *at;
  size_t length;
} ply_word;

static inline int ply_is(ply_word word, const char *text) {
  return word.length == strlen(text) && memcmp(word.at, text, word.length) == 0;
}
static inline int ply_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// Splits the next line of the header into up to `most` words. How many; -1 at the end of the file.
static inline int ply_line(ply_reader *r, ply_word *words, int most) {
  int count = 0;
  if (r->at == r->end) return -1;
  r->line++;
  while (r->at < r->end && *r->at != '\n' && *r->at != '\r') {
    const char *start = r->at;
    while (r->at < r->end && !ply_blank(*r->at)) r->at++;
    if (r->at > start && count < most) {
      words[count].at = start;
      words[count++].length = (size_t)(r->at - start);
    }
    while (r->at < r->end && (*r->at == ' ' || *r->at == '\t')) r->at++;
  }
  const int both = r->end - r->at >= 2 && r->at[0] == '\r' && r->at[1] == '\n' && !r->ends_in_cr;
  if (r->line == 1) r->ends_in_cr = r->at < r->end && *r->at == '\r' && !both;
  r->at += r->at == r->end ? 0 : 1 + both;
  return count;
}

static inline int ply_type_of(ply_word word, ply_type *out) {
  static const struct {
    const char *names[2];
    ply_type type;
  } types[] = {{{"char", "int8"}, {PLY_INTEGER, 1}},   {{"uchar", "uint8"}, {PLY_UNSIGNED, 1}},
               {{"short", "int16"}, {PLY_INTEGER, 2}}, {{"ushort", "uint16"}, {PLY_UNSIGNED, 2}},
               {{"int", "int32"}, {PLY_INTEGER, 4}},   {{"uint", "uint32"}, {PLY_UNSIGNED, 4}},
               {{"float", "float32"}, {PLY_REAL, 4}},  {{"double", "float64"}, {PLY_REAL, 8}}};
  for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
    if (!ply_is(word, types[i].names[0]) && !ply_is(word, types[i].names[1])) continue;
    *out = types[i].type;
    return 1;
  }
  return 0;
}

// One number of an element. out: NULL: it is skipped, and may be no number. Returns 0 with a reason.
static inline int ply_value(ply_reader *r, ply_type type, double *out) {
  if (r->is_text) {
    for (; r->at < r->end && ply_blank(*r->at); r->at++) {
      const int both = *r->at == '\r' && r->end - r->at >= 2 && r->at[1] == '\n';
      r->line += !both && (*r->at == '\n' || *r->at == '\r');
    }
    if (r->at == r->end) return mesh_refuse(r->fault, "it ends before its elements do");
    while (!out && r->at < r->end && !ply_blank(*r->at)) r->at++;
    if (!out) return 1;
    const int good = mesh_number(&r->at, r->end, out);
    if (good && (r->at == r->end || ply_blank(*r->at))) return 1;
    return mesh_refuse(r->fault, "a number is wanted");
  }
  if ((size_t)(r->end - r->at) < type.bytes)
    return mesh_refuse(r->fault, "it ends before its elements do");
  const uint64_t word = mesh_word((const unsigned char *)r->at, type.bytes, r->is_big);
  r->at += type.bytes;
  if (!out) return 1;
  if (type.kind == PLY_REAL && type.bytes == 8) {
    memcpy(out, &word, sizeof *out);
  } else if (type.kind == PLY_REAL) {
    const uint32_t bits = (uint32_t)word;
    float value;
    memcpy(&value, &bits, sizeof value);
    *out = (double)value;
  } else {
    const double past = ldexp(1, 8 * (int)type.bytes);
    *out = (double)word;
    if (type.kind == PLY_INTEGER && *out >= past / 2) *out -= past;
  }
  return 1;
}

// A whole number in 0..2^32 - 1, also where it is written as a real one.
static inline int ply_whole(ply_reader *r, ply_type type, uint32_t *out, const char *reason) {
  double value;
  if (!ply_value(r, type, &value)) return 0;
  if (!(value >= 0 && value <= 4294967295.0) || value != floor(value))
    return mesh_refuse(r->fault, reason);
  *out = (uint32_t)value;
  return 1;
}

// The vertices of strips, `count` numbers: each makes a triangle with the two before it, every other
// one turned round, and -1 begins the next strip. Where two of the three are the same there is none:
// so a strip is led to another place.
static inline int ply_strips(ply_reader *r, ply_type type, uint32_t count) {
  uint32_t last[2] = {0, 0};
  size_t length = 0;
  for (uint32_t i = 0; i < count; i++) {
    double value;
    if (!ply_value(r, type, &value)) return 0;
    if (value == -1 || value == 4294967295.0) {  // -1 as unsigned
      length = 0;
      continue;
    }
    if (!(value >= 0 && value < 4294967295.0) || value != floor(value))
      return mesh_refuse(r->fault, "a corner is no number of a vertex");
    const uint32_t vertex = (uint32_t)value;
    const int is_turned = length % 2 != 0;
    if (length++ >= 2 && last[0] != last[1] && last[0] != vertex && last[1] != vertex) {
      if (!mesh_soup_corner(r->soup, last[is_turned]) ||
          !mesh_soup_corner(r->soup, last[!is_turned]) || !mesh_soup_corner(r->soup, vertex) ||
          !mesh_soup_face(r->soup, 3))
        return mesh_refuse(r->fault, PLY_NO_MEMORY);
    }
    last[0] = last[1];
    last[1] = vertex;
  }
  return 1;
}

// The corners of a face, or any list.
static inline int ply_list(ply_reader *r, const ply_property *property) {
  uint32_t count;
  if (!ply_whole(r, property->length, &count, "a list of less than no length")) return 0;
  if (property->part == 4) return ply_strips(r, property->type, count);
  if (property->part != 3) {
    for (uint32_t i = 0; i < count; i++) {
      if (!ply_value(r, property->type, NULL)) return 0;
    }
    return 1;
  }
  if (count < 3) return mesh_refuse(r->fault, "a face of fewer than three corners");
  for (uint32_t i = 0; i < count; i++) {
    uint32_t vertex;
    if (!ply_whole(r, property->type, &vertex, "a corner is no number of a vertex")) return 0;
    if (!mesh_soup_corner(r->soup, vertex)) return mesh_refuse(r->fault, PLY_NO_MEMORY);
  }
  return mesh_soup_face(r->soup, count) || mesh_refuse(r->fault, PLY_NO_MEMORY);
}

typedef struct ply_element {
  ply_property properties[PLY_PROPERTIES];
  size_t property_count, count;
  int is_vertex, is_face, is_strips;
} ply_element;

static inline int ply_rows(ply_reader *r, const ply_element *element) {
  for (size_t row = 0; row < element->count && element->property_count; row++) {
    double position[3] = {0, 0, 0};
    for (size_t i = 0; i < element->property_count; i++) {
      const ply_property *property = &element->properties[i];
      double *place = property->part >= 0 ? &position[property->part % 3] : NULL;
      if (property->length.bytes ? !ply_list(r, property) : !ply_value(r, property->type, place))
        return 0;
    }
    if (element->is_vertex && !mesh_soup_vertex(r->soup, position))
      return mesh_refuse(r->fault, PLY_NO_MEMORY);
  }
  return 1;
}

static inline int ply_take_format(ply_reader *r, ply_word name) {
  r->is_text = ply_is(name, "ascii");
  r->is_big = ply_is(name, "binary_big_endian");
  if (r->is_text || r->is_big || ply_is(name, "binary_little_endian")) return 1;
  return mesh_refuse(r->fault, "its format is neither ascii nor binary");
}

// element NAME COUNT
static inline int ply_take_element(ply_reader *r, const ply_word *words, int count,
                                   ply_element *element) {
  memset(element, 0, sizeof *element);
  if (count != 3) return mesh_refuse(r->fault, "expected: element NAME COUNT");
  element->is_vertex = ply_is(words[1], "vertex");
  element->is_face = ply_is(words[1], "face");
  element->is_strips = ply_is(words[1], "tristrips");
  for (size_t i = 0; i < words[2].length; i++) {
    const char c = words[2].at[i];
    if (c < '0' || c > '9' || element->count > 0x7fffffff / 10)
      return mesh_refuse(r->fault, "a count of elements that is none");
    element->count = 10 * element->count + (size_t)(c - '0');
  }
  return 1;
}

// property TYPE NAME, or property list TYPE TYPE NAME
static inline int ply_take_property(ply_reader *r, const ply_word *words, int count,
                                    ply_element *element) {
  ply_property *property = &element->properties[element->property_count];
  const int is_list = count == 5 && ply_is(words[1], "list");
  if (element->property_count == PLY_PROPERTIES)
    return mesh_refuse(r->fault, "an element of more than 64 properties");
  memset(property, 0, sizeof *property);
  if ((!is_list && count != 3) || !ply_type_of(words[count - 2], &property->type) ||
      (is_list && !ply_type_of(words[2], &property->length)))
    return mesh_refuse(r->fault, "a property of no type that PLY has");
  const ply_word name = words[count - 1];
  property->part = -1;
  for (int k = 0; k < 3 && element->is_vertex && !is_list; k++) {
    if (name.length == 1 && name.at[0] == "xyz"[k]) property->part = k;
  }
  if (is_list && (ply_is(name, "vertex_indices") || ply_is(name, "vertex_index")))
    property->part = element->is_face ? 3 : element->is_strips ? 4 : -1;
  element->property_count++;
  return 1;
}

#define PLY_ELEMENTS 16

// The elements, in the order of their rows. Returns how many; 0 with a reason.
static inline size_t ply_header(ply_reader *r, ply_element *elements) {
  ply_word words[6];
  size_t count = 0;
  int has_format = 0;
  ply_line(r, words, 6);  // ply
  for (;;) {
    const int n = ply_line(r, words, 6);
    if (n < 0) return (size_t)mesh_refuse(r->fault, "its header has no end");
    if (n == 0 || ply_is(words[0], "comment") || ply_is(words[0], "obj_info")) continue;
    if (ply_is(words[0], "end_header")) break;
    int good = 0;
    if (ply_is(words[0], "format") && n == 3) {
      good = has_format = ply_take_format(r, words[1]);
    } else if (ply_is(words[0], "element") && count < PLY_ELEMENTS) {
      good = ply_take_element(r, words, n, &elements[count++]);
    } else if (ply_is(words[0], "property") && count) {
      good = ply_take_property(r, words, n, &elements[count - 1]);
    }
    if (!good) return (size_t)mesh_refuse(r->fault, "no line of a PLY header");
  }
  if (!has_format || !count) return (size_t)mesh_refuse(r->fault, "its header names no format");
  return count;
}

// Has each coordinate its property?
static inline int ply_has_places(const ply_element *element) {
  unsigned parts = 0;
  for (size_t i = 0; i < element->property_count; i++) {
    if (element->properties[i].part >= 0) parts |= 1u << element->properties[i].part;
  }
  return (parts & 7) == 7;
}

// Reads vertices and faces. Returns 1, or 0 with a reason in *fault; soup is to be freed in any case.
static inline int ply_read(const char *data, size_t size, mesh_soup *soup, mesh_fault *fault) {
  ply_reader r;
  memset(&r, 0, sizeof r);
  r.at = data;
  r.end = data + size;
  r.soup = soup;
  r.fault = fault;
  ply_element *elements = (ply_element *)malloc(PLY_ELEMENTS * sizeof *elements);
  size_t count = elements ? ply_header(&r, elements) : 0;
  int good = count > 0;
  r.line += count > 0;  // the first line of the rows
  for (size_t i = 0; i < count && good; i++) {
    if (elements[i].is_vertex && !ply_has_places(&elements[i]))
      good = mesh_refuse(fault, "its vertices have no x, y and z");
    good = good && ply_rows(&r, &elements[i]);
  }
  if (!elements) mesh_refuse(fault, PLY_NO_MEMORY);
  // a binary file has lines only in its header
  fault->line = good || (count && !r.is_text) ? 0 : r.line;
  free(elements);
  return good;
}

// Returns 1, or 0 with a reason in *fault.
static inline int ply_parse(const char *data, size_t size, const nsvcd_mesh_options *options,
                            const nsvcd_allocator *allocator, nsvcd_mesh *mesh, mesh_fault *fault) {
  mesh_soup soup;
  memset(&soup, 0, sizeof soup);
  soup.options = options;
  int good = ply_read(data, size, &soup, fault);
  if (good && !soup.faces) good = mesh_refuse(fault, "no faces: a cloud of points?");
  good = good && mesh_soup_finish(&soup, allocator, mesh, fault);
  mesh_soup_free(&soup);
  return good;
}

#endif
