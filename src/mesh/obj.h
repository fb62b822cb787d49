// In: the text of a Wavefront OBJ file (version 3.0). Out: nsvcd_mesh. Only the statements v and f
// are used.
//
// Three passes over the text: count, vertices, faces. A face names any vertex of the file by its
// number, a later one too; negative numbers count back from the last vertex so far. The locale
// plays no part. A keyword that is skipped consists of letters, and of digits after the first two
// characters: curv2 is one, f1 is a mistake.
#pragma once
#include "text.h"
#include "polygons.h"

#ifndef NSVCD_NO_READERS
// Goes to the next statement. Skips the rest of this one token by token, so that all passes agree
// on where comments end: a backslash does not continue them. Returns the keyword: v, f, # for any
// other, ? for a word that is none, or 0 at the end of the text.
static int nsvcd__obj_next(nsvcd__text *obj) {
  if (obj->line > 0) {
    while (nsvcd__text_has_token(obj)) nsvcd__text_skip_token(obj);
    while (!nsvcd__text_line_ends(obj)) obj->at++;
    obj->at += nsvcd__text_newline(obj->at, obj->end);
  }
  obj->line++;
  obj->word = NULL;
  if (!nsvcd__text_has_token(obj)) return obj->at == obj->end ? 0 : '#';
  const char *start = obj->at;
  obj->word = start;
  nsvcd__text_skip_token(obj);
  if (obj->at - start == 1 && (*start == 'v' || *start == 'f')) return *start;
  for (const char *p = start; p < obj->at; p++) {
    const int letter = (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || *p == '_';
    const int digit = *p >= '0' && *p <= '9';
    if (!letter && !(digit && p - start >= 2)) return '?';
  }
  return '#';
}

// Reads one corner: v, v/vt, v//vn or v/vt/vn. The numbers after a slash are neither used nor
// checked against a range, and may be missing: some files have v//. vertex_count: of the file.
static nsvcd_result nsvcd__obj_corner(nsvcd__text *obj, uint32_t vertex_count,
                                      uint32_t *vertex) {
  const int negative = nsvcd__text_accept(obj, '-');
  const uint32_t most = negative ? obj->vertices : vertex_count;
  int64_t number, unused;
  if (!nsvcd__text_integer(obj, &number)) return NSVCD_ERROR_SYNTAX;
  for (int i = 0; i < 2 && nsvcd__text_accept(obj, '/'); i++) {
    if (nsvcd__text_token_ends(obj) || (i == 0 && *obj->at == '/')) continue;
    nsvcd__text_accept(obj, '-');
    if (!nsvcd__text_integer(obj, &unused)) return NSVCD_ERROR_SYNTAX;
  }
  if (!nsvcd__text_token_ends(obj)) return NSVCD_ERROR_SYNTAX;
  if (number == 0 || number > (int64_t)most) return NSVCD_ERROR_INDEX;
  *vertex = (uint32_t)(negative ? (int64_t)most - number : number - 1);
  return NSVCD_OK;
}

// Is the statement's keyword one of OBJ's?
static int nsvcd__obj_is_own(const nsvcd__text *obj) {
  static const char words[] =
      " v vt vn vp p l f g o s mg usemtl mtllib usemap maplib "
      "cstype deg bmat step curv curv2 surf parm trim hole scrv "
      "sp end con bevel c_interp d_interp lod shadow_obj "
      "trace_obj ctech stech ";
  const size_t length = (size_t)(obj->at - obj->word);
  for (const char *word = words; *++word; word += strcspn(word, " ")) {
    if (strcspn(word, " ") == length && memcmp(word, obj->word, length) == 0) return 1;
  }
  return 0;
}

// FORMAT if the rest of the text has statements, but none of OBJ's; else `otherwise`. Sets the line
// to that of the first foreign statement. line: where one was found before, or 0.
static nsvcd_result nsvcd__obj_other(nsvcd__text *obj, size_t line, nsvcd_result otherwise) {
  int is_obj = obj->vertices > 0 || obj->triangles > 0;
  while (!is_obj && nsvcd__obj_next(obj)) {
    is_obj = obj->word && nsvcd__obj_is_own(obj);
    if (obj->word && !line) line = obj->line;
  }
  obj->line = line;
  return is_obj || !line ? otherwise : NSVCD_ERROR_FORMAT;
}

// First pass: counts vertices and triangles.
static nsvcd_result nsvcd__obj_count(nsvcd__text *obj) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword == '?') return nsvcd__obj_other(obj, obj->line, NSVCD_ERROR_SYNTAX);
    if (keyword == 'v' && obj->vertices++ == NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
    if (keyword != 'f') continue;
    size_t corners = 0;
    for (; nsvcd__text_has_token(obj); nsvcd__text_skip_token(obj)) corners++;
    if (corners < 3) return NSVCD_ERROR_SYNTAX;
    if (corners - 2 > NSVCD__MAX_COUNT - obj->triangles) return NSVCD_ERROR_TOO_LARGE;
    obj->triangles += (uint32_t)(corners - 2);
    if (corners > obj->max_corners) obj->max_corners = (uint32_t)corners;
  }
  return NSVCD_OK;
}

// Second pass: positions (vertices, 3). Up to five numbers after v x y z (a weight, a colour) are
// skipped; these may be infinite or NaN.
static nsvcd_result nsvcd__obj_vertices(nsvcd__text *obj, float *positions) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword != 'v') continue;
    int count = 0;
    for (; nsvcd__text_has_token(obj); count++) {
      double value = 0;
      nsvcd_result result = nsvcd__text_number(obj, &value);
      if (count >= 3 && result == NSVCD_ERROR_NUMBER) {
        nsvcd__text_skip_token(obj);
        result = NSVCD_OK;
      }
      if (count == 8) result = NSVCD_ERROR_SYNTAX;
      if (!result && count < 3)
        result = nsvcd__mesh_number(&obj->options, (size_t)count, value, positions++);
      if (result) return result;
    }
    if (count < 3) return NSVCD_ERROR_SYNTAX;
  }
  return NSVCD_OK;
}

// Third pass: the mesh's indices. polygon: room for the largest face.
static nsvcd_result nsvcd__obj_faces(nsvcd__text *obj, const nsvcd_mesh *mesh,
                                     nsvcd__polygon *polygon) {
  uint32_t *triangles = mesh->indices;
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    obj->vertices += keyword == 'v';
    if (keyword != 'f') continue;
    polygon->count = 0;
    while (nsvcd__text_has_token(obj)) {
      uint32_t *vertex = &polygon->corners[polygon->count++].vertex;
      const nsvcd_result result = nsvcd__obj_corner(obj, (uint32_t)mesh->vertex_count, vertex);
      if (result) return result;
    }
    nsvcd__polygon_triangulate(polygon, mesh->positions, triangles);
    triangles += 3 * (size_t)(polygon->count - 2);
  }
  return NSVCD_OK;
}

// Reads a text from its beginning. obj->line: where it fails, or 0 if no line is at fault.
static nsvcd_result nsvcd__obj_read(nsvcd__text *obj, nsvcd__arena *arena, nsvcd_mesh *mesh) {
  const nsvcd__text begin = *obj;
  nsvcd__polygon polygon;
  nsvcd_result result = nsvcd__obj_count(obj);
  if (result) return result;
  obj->line = 0;
  if (obj->triangles == 0) {
    if (obj->vertices == 0) *obj = begin;
    result = nsvcd__obj_other(obj, 0, NSVCD_ERROR_EMPTY);
    if (result == NSVCD_ERROR_EMPTY) obj->line = 0;
    return result;
  }
  if (!nsvcd__mesh_alloc(mesh, obj->vertices, obj->triangles, arena->allocator) ||
      !nsvcd__polygon_alloc(&polygon, obj->max_corners, arena))
    return NSVCD_ERROR_MEMORY;
  *obj = begin;
  result = nsvcd__obj_vertices(obj, mesh->positions);
  if (result) return result;
  *obj = begin;
  return nsvcd__obj_faces(obj, mesh, &polygon);
}
#endif  // NSVCD_NO_READERS
