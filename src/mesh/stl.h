// In: an STL file, binary or text. Out: nsvcd_mesh.
//
// A file is binary if it has the size that its count of triangles says, does not begin with
// "solid", or holds a NUL, which no text does. Of a text only the words vertex and endloop matter:
// three vertices a loop.
#pragma once
#include "weld.h"
#include "text.h"

#ifndef NSVCD_NO_READERS
#define NSVCD__STL_HEADER 84  // bytes, the count of triangles included
#define NSVCD__STL_FACET 50

static uint32_t nsvcd__stl_word(const unsigned char *p) {
  return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

// The size of a binary file with the count of triangles that this one has.
static uint64_t nsvcd__stl_size(const void *data, size_t size) {
  const unsigned char *count = (const unsigned char *)data + 80;
  const uint64_t triangles = size < NSVCD__STL_HEADER ? 0 : nsvcd__stl_word(count);
  return NSVCD__STL_HEADER + NSVCD__STL_FACET * triangles;
}

// Reads the corners (count, 3) of a binary file.
static nsvcd_result nsvcd__stl_binary(const void *data, const nsvcd_mesh_options *options,
                                      float *corners, size_t count) {
  const unsigned char *first = (const unsigned char *)data + NSVCD__STL_HEADER;
  for (size_t i = 0; i < 3 * count; i++) {
    // a facet's normal comes before its corners
    const unsigned char *at = first + NSVCD__STL_FACET * (i / 9) + 12 + 4 * (i % 9);
    const uint32_t bits = nsvcd__stl_word(at);
    float value;
    memcpy(&value, &bits, sizeof bits);
    const nsvcd_result result = nsvcd__mesh_number(options, i % 3, (double)value, &corners[i]);
    if (result) return result;
  }
  return NSVCD_OK;
}

// Goes to the next token, on whichever line; 0 at the end of the text.
static int nsvcd__stl_token(nsvcd__text *text) {
  for (;;) {
    const size_t newline = nsvcd__text_newline(text->at, text->end);
    const size_t skipped = newline ? newline : nsvcd__text_blank(text->at, text->end);
    if (!skipped) return text->at < text->end;
    text->line += newline > 0;
    text->at += skipped;
  }
}

// Passes the token if it is this word, in whatever case.
static int nsvcd__stl_accept(nsvcd__text *text, const char *word) {
  const char *p = text->at;
  for (; *word; word++, p++) {
    if (p == text->end || (*p | 32) != *word) return 0;
  }
  nsvcd__text rest = *text;
  rest.at = p;
  if (!nsvcd__text_token_ends(&rest)) return 0;
  text->at = p;
  return 1;
}

// Does a text begin with the word "solid"?
static int nsvcd__stl_is_solid(nsvcd__text text) {
  return nsvcd__stl_token(&text) && nsvcd__stl_accept(&text, "solid");
}

// Reads the corners (count, 3) of a text; NULL: only counts them.
static nsvcd_result nsvcd__stl_text(nsvcd__text *text, float *corners, size_t *count) {
  size_t in_loop = 0;
  *count = 0;
  while (nsvcd__stl_token(text)) {
    if (nsvcd__stl_accept(text, "solid") || nsvcd__stl_accept(text, "endsolid")) {
      // a name follows
      while (!nsvcd__text_line_ends(text)) text->at++;
    } else if (nsvcd__stl_accept(text, "endloop")) {
      if (in_loop != 3) return NSVCD_ERROR_SYNTAX;
      in_loop = 0;
    } else if (nsvcd__stl_accept(text, "vertex")) {
      for (size_t k = 0; k < 3 && corners; k++) {
        double value = 0;
        if (!nsvcd__stl_token(text)) return NSVCD_ERROR_SYNTAX;
        nsvcd_result result = nsvcd__text_number(text, &value);
        float *corner = corners + 3 * *count + k;
        if (!result) result = nsvcd__mesh_number(&text->options, k, value, corner);
        if (result) return result;
      }
      in_loop++;
      ++*count;
    } else {
      nsvcd__text_skip_token(text);
    }
  }
  return in_loop == 0 ? NSVCD_OK : NSVCD_ERROR_SYNTAX;
}

// Welds corners (3 triangles, 3), which become vertices. 0 without memory.
static int nsvcd__stl_weld(nsvcd_mesh *mesh, const nsvcd_allocator *alloc) {
  float *positions = mesh->positions;
  uint32_t *indices = mesh->indices;
  uint32_t count = 0;
  if (!nsvcd__weld_all(positions, mesh->vertex_count, indices, alloc)) return 0;
  for (size_t i = 0; i < mesh->vertex_count; i++) {
    const int is_first = indices[i] == i;
    indices[i] = is_first ? count : indices[indices[i]];
    if (!is_first) continue;
    for (size_t k = 0; k < 3; k++)
      // -0 becomes 0
      positions[3 * (size_t)count + k] = positions[3 * i + k] + 0.0f;
    count++;
  }
  mesh->vertex_count = count;
  return 1;
}

// Reads a file, of which `text` is at the beginning. text->line: where it fails, or 0 if no line is
// at fault.
static nsvcd_result nsvcd__stl_read(nsvcd__text *text, const void *data, size_t size,
                                    const nsvcd_allocator *alloc, nsvcd_mesh *mesh) {
  const nsvcd__text begin = *text;
  const uint64_t needed = nsvcd__stl_size(data, size);
  const int is_binary = size == needed || !nsvcd__stl_is_solid(begin) || memchr(data, 0, size);
  if (is_binary && size < needed) return NSVCD_ERROR_FORMAT;
  nsvcd_result result = NSVCD_OK;
  size_t corners = 3 * (size_t)((needed - NSVCD__STL_HEADER) / NSVCD__STL_FACET);
  text->line = 1;
  if (!is_binary) result = nsvcd__stl_text(text, NULL, &corners);
  if (result) return result;
  text->line = 0;
  if (corners > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  if (corners == 0) return NSVCD_ERROR_EMPTY;
  if (!nsvcd__mesh_alloc(mesh, corners, corners / 3, alloc)) return NSVCD_ERROR_MEMORY;
  if (is_binary) {
    result = nsvcd__stl_binary(data, &text->options, mesh->positions, corners);
  } else {
    *text = begin;
    text->line = 1;
    result = nsvcd__stl_text(text, mesh->positions, &corners);
  }
  if (result) return result;
  text->line = 0;
  return nsvcd__stl_weld(mesh, alloc) ? NSVCD_OK : NSVCD_ERROR_MEMORY;
}
#endif  // NSVCD_NO_READERS
