// In: the text of a Wavefront OBJ file (version 3.0). Out: nsvcd_mesh. Only the statements v and f
// are used.
//
// Three passes over the text: count, vertices, faces. A face names any vertex of the file by its
// number, a later one too; negative numbers count back from the last vertex so far. The locale
// plays no part. A keyword that is skipped consists of letters, and of digits after the first two
// characters: curv2 is one, f1 is a mistake.
#pragma once
#include "mesh.h"
#include "polygons.h"

#ifndef NSVCD_NO_READERS
// Fills zeroed options with those given (NULL: none) and with defaults.
static nsvcd_result nsvcd__mesh_options_of(const nsvcd_mesh_options *given,
                                           nsvcd_mesh_options *out) {
  if (given) *out = *given;
  for (size_t k = 0; k < 3; k++) {
    if (!(fabs(out->origin[k]) < HUGE_VAL)) return NSVCD_ERROR_NUMBER;
  }
  if (!(out->scale >= 0 && out->scale < HUGE_VAL)) return NSVCD_ERROR_SCALE;
  if (!(out->scale > 0)) out->scale = 1;
  return NSVCD_OK;
}

// Turns a coordinate of the file into metres. The limit is on metres, not on the file's number.
static nsvcd_result nsvcd__mesh_number(const nsvcd_mesh_options *options, size_t axis,
                                       double value, float *out) {
  const double metres = (value - options->origin[axis]) * options->scale;
  if (!(fabs(metres) <= (double)NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  *out = (float)metres;
  return NSVCD_OK;
}

// A text that is being read.
typedef struct nsvcd__obj {
  const char *at, *end;
  // the statement's first token, or NULL
  const char *word;
  nsvcd_mesh_options options;
  // of `at`, from 1; 0: before the first
  size_t line;
  // counted so far
  uint32_t vertices, triangles;
  uint32_t max_corners;  // of a face
} nsvcd__obj;

// Length of the newline at p, or 0.
static size_t nsvcd__obj_newline(const char *p, const char *end) {
  if (p == end || (*p != '\n' && *p != '\r')) return 0;
  return end - p >= 2 && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
}
// Length of the blank at p, or 0. A backslash and a newline are a blank: the statement goes on.
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
// Reads digits; returns 0 if there are none. The number saturates, above any limit.
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
    // a fast path over characters that end no token
    while (obj->at + 1 < obj->end && (unsigned char)obj->at[1] > ' ' && obj->at[1] != '\\')
      obj->at++;
  }
}

// Skips blanks. Returns 0 at the end of the statement.
static int nsvcd__obj_has_token(nsvcd__obj *obj) {
  size_t blank = nsvcd__obj_blank(obj->at, obj->end);
  while (blank > 0) {
    obj->line += blank > 1;
    obj->at += blank;
    blank = nsvcd__obj_blank(obj->at, obj->end);
  }
  return !nsvcd__obj_line_ends(obj) && *obj->at != '#';
}

// Goes to the next statement. Skips the rest of this one token by token, so that all passes agree
// on where comments end: a backslash does not continue them. Returns the keyword: v, f, # for any
// other, ? for a word that is none, or 0 at the end of the text.
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

// mantissa * 10^exponent, exponent in -400..400. Powers up to 10^22 are exact, so there is usually
// a single rounding.
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

// Reads a decimal number. Its relative error is at most 2^-52, and a few times that where the
// exponent is beyond +-22: rounded to float it is the nearest one, except for ties. NUMBER if it is
// infinite or NaN as printf writes them (nan, -nan(ind), inf, 1.#QNAN).
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
    // 19 digits are kept, the rest only move the point
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

// Reads one corner: v, v/vt, v//vn or v/vt/vn. The numbers after a slash are neither used nor
// checked against a range, and may be missing: some files have v//. vertex_count: of the file.
static nsvcd_result nsvcd__obj_corner(nsvcd__obj *obj, uint32_t vertex_count,
                                      uint32_t *vertex) {
  const int negative = nsvcd__obj_accept(obj, '-');
  const uint32_t most = negative ? obj->vertices : vertex_count;
  int64_t number, unused;
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

// FORMAT if the rest of the text has statements, but none of OBJ's; else `otherwise`. Sets the line
// to that of the first foreign statement. line: where one was found before, or 0.
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

// Second pass: positions (vertices, 3). Up to five numbers after v x y z (a weight, a colour) are
// skipped; these may be infinite or NaN.
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

// Third pass: the mesh's indices. polygon: room for the largest face.
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

// Reads a text from its beginning. obj->line: where it fails, or 0 if no line is at fault.
static nsvcd_result nsvcd__obj_read(nsvcd__obj *obj, nsvcd__arena *arena, nsvcd_mesh *mesh) {
  const nsvcd__obj begin = *obj;
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
