// In: an STL file, binary or text. Out: nsvcd_mesh.
//
// Binary is what has the size that its count of triangles says, does not begin with "solid", or
// holds a NUL, as no text does. Of text only the words vertex and endloop count: three vertices a
// loop.
#pragma once
#include "obj.h"

#ifndef NSVCD_NO_OBJ
#define NSVCD__STL_HEADER 84  // bytes, the count of triangles included
#define NSVCD__STL_FACET 50

static uint32_t nsvcd__stl_word(const unsigned char *p) {
  return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

// Three floats of a file that is binary.
static nsvcd_result nsvcd__stl_corner(const unsigned char *at,
                                      const nsvcd_mesh_options *options, float *out) {
  nsvcd_result result = NSVCD_OK;
  for (size_t k = 0; k < 3 && !result; k++) {
    const uint32_t bits = nsvcd__stl_word(at + 4 * k);
    float value;
    memcpy(&value, &bits, sizeof bits);
    result = nsvcd__mesh_number(options, k, (double)value, &out[k]);
  }
  return result;
}

// Goes to the next token, past the ends of lines; 0 at the end of the text.
static int nsvcd__stl_token(nsvcd__obj *text) {
  for (;;) {
    const size_t newline = nsvcd__obj_newline(text->at, text->end);
    const size_t skipped = newline ? newline : nsvcd__obj_blank(text->at, text->end);
    if (!skipped) return text->at < text->end;
    text->line += newline > 0;
    text->at += skipped;
  }
}

// Is the token this word, in small letters or capitals? Then it is passed.
static int nsvcd__stl_accept(nsvcd__obj *text, const char *word) {
  const char *p = text->at;
  for (; *word; word++, p++) {
    if (p == text->end || (*p | 32) != *word) return 0;
  }
  nsvcd__obj rest = *text;
  rest.at = p;
  if (!nsvcd__obj_token_ends(&rest)) return 0;
  text->at = p;
  return 1;
}

// Reads corners (count, 3) of a text, or, where that is NULL, only counts them.
static nsvcd_result nsvcd__stl_text(nsvcd__obj *text, float *corners, size_t *count) {
  size_t in_loop = 0;
  *count = 0;
  while (nsvcd__stl_token(text)) {
    if (nsvcd__stl_accept(text, "solid") || nsvcd__stl_accept(text, "endsolid")) {
      // a name follows
      while (!nsvcd__obj_line_ends(text)) text->at++;
    } else if (nsvcd__stl_accept(text, "endloop")) {
      if (in_loop != 3) return NSVCD_ERROR_SYNTAX;
      in_loop = 0;
    } else if (nsvcd__stl_accept(text, "vertex")) {
      for (size_t k = 0; k < 3 && corners; k++) {
        double value = 0;
        if (!nsvcd__stl_token(text)) return NSVCD_ERROR_SYNTAX;
        nsvcd_result result = nsvcd__obj_number(text, &value);
        float *corner = corners + 3 * *count + k;
        if (!result) result = nsvcd__mesh_number(&text->options, k, value, corner);
        if (result) return result;
      }
      in_loop++;
      ++*count;
    } else {
      nsvcd__obj_skip_token(text);
    }
  }
  return in_loop == 0 ? NSVCD_OK : NSVCD_ERROR_SYNTAX;
}

// Vertices by their places.
typedef struct nsvcd__stl_positions {
  // (slots), a power of two: numbers + 1, 0 where none is
  uint32_t *table;
  size_t slots;
  // of the hash
  uint64_t seed;
  // along the table, past vertices elsewhere
  size_t steps;
} nsvcd__stl_positions;

// The slot of the vertex at this place, or where it belongs.
static uint32_t *nsvcd__stl_find(nsvcd__stl_positions *found, const float *positions,
                                 const float *corner) {
  uint32_t bits[3];
  uint64_t hash = found->seed;
  memcpy(bits, corner, sizeof bits);
  for (size_t k = 0; k < 3; k++) {
    hash = (hash ^ bits[k]) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 32;
  }
  for (size_t slot = (size_t)hash;; slot++, found->steps++) {
    uint32_t *at = &found->table[slot & (found->slots - 1)];
    if (!*at || memcmp(positions + 3 * (size_t)(*at - 1), corner, sizeof bits) == 0) return at;
  }
}

// Makes one vertex of corners at the same place: corners (3 triangles, 3) become positions, and
// their numbers indices. Where it takes many steps, as of corners that are chosen to share a hash,
// another hash is taken. The table is of zeros.
static void nsvcd__stl_weld(nsvcd_mesh *mesh, nsvcd__stl_positions *found) {
  const size_t corners = mesh->vertex_count;
  float *positions = mesh->positions;
  size_t count = 0;
  for (size_t i = 0; i < corners; i++) {
    const size_t most = 8 * i + 1024;
    float corner[3];
    for (size_t k = 0; k < 3; k++) corner[k] = positions[3 * i + k] + 0.0f;  // -0 is 0
    uint32_t *at = nsvcd__stl_find(found, positions, corner);
    if (!*at) {
      memcpy(positions + 3 * count, corner, sizeof corner);
      *at = (uint32_t)++count;
    }
    mesh->indices[i] = *at - 1;
    while (found->steps > most) {
      // where memory lies is not known to who made the file
      found->seed += UINT64_C(0xd1342543de82ef95) + (uint64_t)(size_t)found->table;
      found->steps = 0;
      memset(found->table, 0, found->slots * sizeof *found->table);
      for (size_t v = 0; v < count && found->steps <= most; v++)
        *nsvcd__stl_find(found, positions, positions + 3 * v) = (uint32_t)v + 1;
    }
  }
  mesh->vertex_count = count;
}

// As nsvcd_stl_parse. options: NULL, or what the caller gave.
static nsvcd_result nsvcd__stl_read(const void *data, size_t size,
                                    const nsvcd_mesh_options *options,
                                    const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                    size_t *error_line) {
  const unsigned char *bytes = (const unsigned char *)data;
  if (error_line) *error_line = 0;
  if (!mesh || !data) return NSVCD_ERROR_ARGUMENT;
  nsvcd__obj text;
  nsvcd_mesh_options o;
  nsvcd_result result = nsvcd__mesh_options_of(options, &o);
  if (result) return result;
  size_t corners = 0;
  nsvcd__obj_begin(&text, (const char *)data, size);
  const int is_solid = nsvcd__stl_token(&text) && nsvcd__stl_accept(&text, "solid");
  const uint64_t told = size < NSVCD__STL_HEADER ? 0 : nsvcd__stl_word(bytes + 80);
  const uint64_t needed = NSVCD__STL_HEADER + NSVCD__STL_FACET * told;
  const int is_binary = size == needed || !is_solid || memchr(data, 0, size);
  if (is_binary && size < needed) return NSVCD_ERROR_FORMAT;
  nsvcd__obj_begin(&text, (const char *)data, size);
  text.line = 1;
  if (is_binary) {
    if (told > NSVCD__MAX_COUNT / 3) return NSVCD_ERROR_TOO_LARGE;
    corners = 3 * (size_t)told;
  } else {
    result = nsvcd__stl_text(&text, NULL, &corners);
    if (!result && corners > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  }
  if (!result && corners == 0) return NSVCD_ERROR_EMPTY;
  nsvcd_mesh out;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  memset(&out, 0, sizeof out);
  nsvcd__stl_positions positions = {NULL, 16, 0, 0};
  while (positions.slots < 2 * corners) positions.slots *= 2;
  if (!result) {
    positions.table = NSVCD__TAKE(&arena, uint32_t, positions.slots);
    if (!positions.table || !nsvcd__mesh_alloc(&out, corners, corners / 3, allocator)) {
      text.line = 0;
      result = NSVCD_ERROR_MEMORY;
    }
  }
  if (!result && !is_binary) {
    nsvcd__obj_begin(&text, (const char *)data, size);
    text.line = 1;
    text.options = o;
    result = nsvcd__stl_text(&text, out.positions, &corners);
  }
  for (size_t i = 0; i < corners && is_binary && !result; i++) {
    const size_t facet = NSVCD__STL_HEADER + NSVCD__STL_FACET * (i / 3);
    result = nsvcd__stl_corner(bytes + facet + 12 * (1 + i % 3), &o, out.positions + 3 * i);
  }
  if (!result) nsvcd__stl_weld(&out, &positions);
  nsvcd__arena_free(&arena);
  if (result) {
    if (error_line && !is_binary) *error_line = text.line;
    nsvcd_mesh_free(&out, allocator);
    return result;
  }
  *mesh = out;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  return nsvcd__stl_read(data, size, NULL, allocator, mesh, error_line);
}
#endif  // NSVCD_NO_OBJ
