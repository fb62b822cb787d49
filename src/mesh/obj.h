// In: the text of a Wavefront OBJ file (version 3.0). Out: nsvcd_mesh. Statements v and f count,
// all else is skipped.
//
// Three passes over the text: count, vertices, faces. A face may refer to any vertex of the file by
// its number, also to a later one; negative numbers count back from the last vertex so far. Locale
// plays no part. Keywords that are skipped are letters, and digits behind two of them: curv2 is
// one, f1 is a mistake.
#pragma once
#include "mesh.h"
#include "polygons.h"

#ifndef NSVCD_NO_OBJ
// Options with their defaults filled in; what a file's reader is given.
static nsvcd_result nsvcd__mesh_options_of(const nsvcd_mesh_options *given,
                                           nsvcd_mesh_options *out) {
  memset(out, 0, sizeof *out);
  if (given) *out = *given;
  for (size_t k = 0; k < 3; k++) {
    if (!(fabs(out->origin[k]) < HUGE_VAL)) return NSVCD_ERROR_NUMBER;
  }
  if (!(out->scale >= 0 && out->scale < HUGE_VAL)) return NSVCD_ERROR_SCALE;
  if (!(out->scale > 0)) out->scale = 1;
  return NSVCD_OK;
}

// A coordinate of a file, in metres. The limit is that of what becomes of it, not of what is read.
static nsvcd_result nsvcd__mesh_number(const nsvcd_mesh_options *options, size_t axis,
                                       double value, float *out) {
  const double metres = (value - options->origin[axis]) * options->scale;
  if (!(fabs(metres) <= (double)NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  *out = (float)metres;
  return NSVCD_OK;
}

typedef struct nsvcd__obj {
  const char *at, *end;
  // the first token of the statement; NULL: there is none
  const char *word;
  nsvcd_mesh_options options;
  size_t line;  // of `at`, from 1; 0: before the first
  // v statements so far
  uint32_t vertices;
  // so far, from f statements
  uint32_t triangles;
  // of a face
  uint32_t max_corners;
} nsvcd__obj;

// Length of the line's end at p; 0: there is none.
static size_t nsvcd__obj_newline(const char *p, const char *end) {
  if (p == end || (*p != '\n' && *p != '\r')) return 0;
  return end - p >= 2 && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
}
// Length of the blank at p: a backslash before the line's end continues the statement on the next
// line.
static inline size_t nsvcd__obj_blank(const char *p, const char *end) {
  if (p == end) return 0;
  if (*p == ' ' || *p == '\t' || *p == '\v' || *p == '\f') return 1;
  if (*p != '\\') return 0;
  const size_t newline = nsvcd__obj_newline(p + 1, end);
  return newline > 0 ? 1 + newline : 0;
}
static int nsvcd__obj_is_digit(const nsvcd__obj *obj) {
  return obj->at < obj->end && *obj->at >= '0' && *obj->at <= '9';
}
static int nsvcd__obj_accept(nsvcd__obj *obj, char c) {
  const int is_there = obj->at < obj->end && *obj->at == c;
  if (is_there) obj->at++;
  return is_there;
}
static int nsvcd__obj_line_ends(const nsvcd__obj *obj) {
  return obj->at == obj->end || *obj->at == '\n' || *obj->at == '\r';
}
// Reads digits; 0 where there is none. What is too large for any use stays too large.
static int nsvcd__obj_integer(nsvcd__obj *obj, int64_t *number) {
  const char *start = obj->at;
  for (*number = 0; nsvcd__obj_is_digit(obj); obj->at++) {
    if (*number < 1000000000000000) *number = 10 * *number + (*obj->at - '0');
  }
  return obj->at > start;
}
static int nsvcd__obj_token_ends(const nsvcd__obj *obj) {
  if (nsvcd__obj_line_ends(obj)) return 1;
  return nsvcd__obj_blank(obj->at, obj->end) > 0;
}
static inline void nsvcd__obj_skip_token(nsvcd__obj *obj) {
  for (; !nsvcd__obj_token_ends(obj); obj->at++) {
    // what can be nothing else, quickly
    while (obj->at + 1 < obj->end && (unsigned char)obj->at[1] > ' ' && obj->at[1] != '\\')
      obj->at++;
  }
}

// Skips blanks; 0 where the statement ends instead.
static int nsvcd__obj_has_token(nsvcd__obj *obj) {
  size_t blank = nsvcd__obj_blank(obj->at, obj->end);
  while (blank > 0) {
    obj->line += blank > 1;
    obj->at += blank;
    blank = nsvcd__obj_blank(obj->at, obj->end);
  }
  return !nsvcd__obj_line_ends(obj) && *obj->at != '#';
}

// To the next statement, past what is left of this one. Token by token, as all passes read it: what
// one takes for a comment, which nothing continues, all do. Returns its keyword: v, f, a hash for
// any other, ? for what is none, or 0 at the end of the text.
static int nsvcd__obj_next(nsvcd__obj *obj) {
  if (obj->line > 0) {
    while (nsvcd__obj_has_token(obj)) nsvcd__obj_skip_token(obj);
    while (!nsvcd__obj_line_ends(obj)) obj->at++;
    obj->at += nsvcd__obj_newline(obj->at, obj->end);
  }
  obj->line++;
  obj->word = NULL;
  if (!nsvcd__obj_has_token(obj)) return obj->at == obj->end ? 0 : '#';
  const char *start = obj->at;
  obj->word = start;
  nsvcd__obj_skip_token(obj);
  if (obj->at - start == 1 && (*start == 'v' || *start == 'f')) return *start;
  for (const char *p = start; p < obj->at; p++) {
    const int letter = (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || *p == '_';
    const int digit = *p >= '0' && *p <= '9';
    if (!letter && !(digit && p - start >= 2)) return '?';
  }
  return '#';
}

// value = mantissa * 10^exponent, exponent in -400..400. Powers up to 10^22 are exact: one rounding
// in the usual case.
static double nsvcd__obj_scale(uint64_t mantissa, int exponent) {
  static const double power[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  double value = (double)mantissa;
  for (; exponent > 22; exponent -= 22) value *= power[22];
  for (; exponent < -22; exponent += 22) value /= power[22];
  return exponent < 0 ? value / power[-exponent] : value * power[exponent];
}

// Accepts a sign; returns 1 if it is a minus.
static int nsvcd__obj_minus(nsvcd__obj *obj) {
  const int minus = nsvcd__obj_accept(obj, '-');
  if (!minus) nsvcd__obj_accept(obj, '+');
  return minus;
}

// A decimal number, as a double: within 2^-52 of it, or a few of these where its exponent is beyond
// +-22. Rounded to float it is the nearest, unless two floats are as near. NUMBER where it is an
// infinity or not a number, as printf has them (nan, -nan(ind), inf, 1.#QNAN).
static nsvcd_result nsvcd__obj_number(nsvcd__obj *obj, double *value) {
  const int negative = nsvcd__obj_minus(obj);
  if (obj->at < obj->end && strchr("nNiI", *obj->at) && *obj->at) return NSVCD_ERROR_NUMBER;
  // digits and a point: mantissa * 10^exponent
  uint64_t mantissa = 0;
  int64_t exponent = 0;
  int digits = 0;
  for (int point = 0;; obj->at++) {
    if (!point && nsvcd__obj_accept(obj, '.')) point = 1;
    if (!nsvcd__obj_is_digit(obj)) break;
    digits = 1;
    // 19 digits are kept, the rest only moves the point
    const int fits = mantissa < 1000000000000000000u;
    if (fits) mantissa = 10 * mantissa + (uint64_t)(*obj->at - '0');
    exponent += !fits - point;
  }
  if (!digits) return NSVCD_ERROR_SYNTAX;
  if (obj->at[-1] == '.' && nsvcd__obj_accept(obj, '#')) return NSVCD_ERROR_NUMBER;
  if (nsvcd__obj_accept(obj, 'e') || nsvcd__obj_accept(obj, 'E')) {
    const int minus = nsvcd__obj_minus(obj);
    int64_t written;
    if (!nsvcd__obj_integer(obj, &written)) return NSVCD_ERROR_SYNTAX;
    exponent += minus ? -written : written;
  }
  if (!nsvcd__obj_token_ends(obj)) return NSVCD_ERROR_SYNTAX;
  if (mantissa == 0) exponent = 0;
  if (exponent > 400) return NSVCD_ERROR_NUMBER;
  const int power = exponent < -400 ? -400 : (int)exponent;
  const double magnitude = nsvcd__obj_scale(mantissa, power);
  *value = negative ? -magnitude : magnitude;
  return NSVCD_OK;
}

// One corner: v, v/vt, v//vn or v/vt/vn. The numbers after a slash are not used, nor checked
// against a range, and may be missing: some write v// where there are neither. vertex_count: of the
// file.
static nsvcd_result nsvcd__obj_corner(nsvcd__obj *obj, uint32_t vertex_count,
                                      uint32_t *vertex) {
  const int negative = nsvcd__obj_accept(obj, '-');
  const uint32_t most = negative ? obj->vertices : vertex_count;
  int64_t number;
  int64_t unused;
  if (!nsvcd__obj_integer(obj, &number)) return NSVCD_ERROR_SYNTAX;
  for (int i = 0; i < 2 && nsvcd__obj_accept(obj, '/'); i++) {
    if (nsvcd__obj_token_ends(obj) || (i == 0 && *obj->at == '/')) continue;
    nsvcd__obj_accept(obj, '-');
    if (!nsvcd__obj_integer(obj, &unused)) return NSVCD_ERROR_SYNTAX;
  }
  if (!nsvcd__obj_token_ends(obj)) return NSVCD_ERROR_SYNTAX;
  if (number == 0 || number > (int64_t)most) return NSVCD_ERROR_INDEX;
  *vertex = (uint32_t)(negative ? (int64_t)most - number : number - 1);
  return NSVCD_OK;
}

static void nsvcd__obj_begin(nsvcd__obj *obj, const char *text, size_t size) {
  memset(obj, 0, sizeof *obj);
  obj->at = text;
  obj->end = text + size;
  // UTF-8 byte order mark
  if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) obj->at += 3;
}

// Is the statement's keyword one of OBJ's?
static int nsvcd__obj_is_own(const nsvcd__obj *obj) {
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

// Is what is left of a text no OBJ: statements of others, and none of its own? Then the first of
// them is told of. line: of one that was found before, or 0.
static nsvcd_result nsvcd__obj_other(nsvcd__obj *obj, size_t line, nsvcd_result otherwise) {
  int is_obj = obj->vertices > 0 || obj->triangles > 0;
  while (!is_obj && nsvcd__obj_next(obj)) {
    is_obj = obj->word && nsvcd__obj_is_own(obj);
    if (obj->word && !line) line = obj->line;
  }
  obj->line = line;
  return is_obj || !line ? otherwise : NSVCD_ERROR_FORMAT;
}

// First pass: counts vertices and triangles.
static nsvcd_result nsvcd__obj_count(nsvcd__obj *obj) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword == '?') return nsvcd__obj_other(obj, obj->line, NSVCD_ERROR_SYNTAX);
    if (keyword == 'v' && obj->vertices++ == NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
    if (keyword != 'f') continue;
    size_t corners = 0;
    for (; nsvcd__obj_has_token(obj); nsvcd__obj_skip_token(obj)) corners++;
    if (corners < 3) return NSVCD_ERROR_SYNTAX;
    if (corners - 2 > NSVCD__MAX_COUNT - obj->triangles) return NSVCD_ERROR_TOO_LARGE;
    obj->triangles += (uint32_t)(corners - 2);
    if (corners > obj->max_corners) obj->max_corners = (uint32_t)corners;
  }
  return NSVCD_OK;
}

// Second pass: positions (vertices, 3), of v x y z, then up to five more: a weight, a colour. These
// are skipped, but must be numbers, if not finite ones.
static nsvcd_result nsvcd__obj_vertices(nsvcd__obj *obj, float *positions) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword != 'v') continue;
    int count = 0;
    for (; nsvcd__obj_has_token(obj); count++) {
      double value = 0;
      nsvcd_result result = nsvcd__obj_number(obj, &value);
      if (count >= 3 && result == NSVCD_ERROR_NUMBER) {
        nsvcd__obj_skip_token(obj);
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

// Third pass: the mesh's indices. polygon: with room for any face.
static nsvcd_result nsvcd__obj_faces(nsvcd__obj *obj, const nsvcd_mesh *mesh,
                                     nsvcd__polygon *polygon) {
  uint32_t *triangles = mesh->indices;
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    obj->vertices += keyword == 'v';
    if (keyword != 'f') continue;
    polygon->count = 0;
    while (nsvcd__obj_has_token(obj)) {
      uint32_t *vertex = &polygon->corners[polygon->count++].vertex;
      const nsvcd_result result = nsvcd__obj_corner(obj, (uint32_t)mesh->vertex_count, vertex);
      if (result) return result;
    }
    nsvcd__polygon_triangulate(polygon, mesh->positions, triangles);
    triangles += 3 * (size_t)(polygon->count - 2);
  }
  return NSVCD_OK;
}

// As nsvcd_obj_parse. options: NULL, or what the caller gave.
static nsvcd_result nsvcd__obj_read(const char *text, size_t size,
                                    const nsvcd_mesh_options *options,
                                    const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                    size_t *error_line) {
  if (error_line) *error_line = 0;
  if (!mesh || !text) return NSVCD_ERROR_ARGUMENT;
  nsvcd_mesh parsed;
  nsvcd__obj obj;
  nsvcd__polygon polygon;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  nsvcd_mesh_options o;
  nsvcd_result result = nsvcd__mesh_options_of(options, &o);
  if (result) return result;
  memset(&parsed, 0, sizeof parsed);
  nsvcd__obj_begin(&obj, text, size);
  result = nsvcd__obj_count(&obj);
  if (!result) {
    // what follows is not tied to a line
    obj.line = 0;
    if (obj.triangles == 0) {
      if (obj.vertices == 0) nsvcd__obj_begin(&obj, text, size);
      result = nsvcd__obj_other(&obj, 0, NSVCD_ERROR_EMPTY);
      if (result == NSVCD_ERROR_EMPTY) obj.line = 0;
    } else if (!nsvcd__mesh_alloc(&parsed, obj.vertices, obj.triangles, allocator) ||
               !nsvcd__polygon_alloc(&polygon, obj.max_corners, &arena)) {
      result = NSVCD_ERROR_MEMORY;
    }
  }
  if (!result) {
    nsvcd__obj_begin(&obj, text, size);
    obj.options = o;
    result = nsvcd__obj_vertices(&obj, parsed.positions);
  }
  if (!result) {
    nsvcd__obj_begin(&obj, text, size);
    result = nsvcd__obj_faces(&obj, &parsed, &polygon);
  }
  nsvcd__arena_free(&arena);
  if (result) {
    if (error_line) *error_line = obj.line;
    nsvcd_mesh_free(&parsed, allocator);
    return result;
  }
  *mesh = parsed;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  return nsvcd__obj_read(text, size, NULL, allocator, mesh, error_line);
}
#endif  // NSVCD_NO_OBJ
