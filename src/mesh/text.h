// In: the bytes of a text. Out: its tokens and numbers, one after another, and coordinates in
// metres. What the readers of mesh files share.
#pragma once
#include "mesh.h"

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
typedef struct nsvcd__text {
  const char *at, *end;
  // the statement's first token, or NULL
  const char *word;
  nsvcd_mesh_options options;
  // of `at`, from 1; 0: before the first
  size_t line;
  // counted so far
  uint32_t vertices, triangles;
  uint32_t max_corners;  // of a face
} nsvcd__text;

// Length of the newline at p, or 0.
static size_t nsvcd__text_newline(const char *p, const char *end) {
  if (p == end || (*p != '\n' && *p != '\r')) return 0;
  return end - p >= 2 && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
}
// Length of the blank at p, or 0. A backslash and a newline are a blank: the statement goes on.
static inline size_t nsvcd__text_blank(const char *p, const char *end) {
  if (p == end) return 0;
  if (*p == ' ' || *p == '\t' || *p == '\v' || *p == '\f') return 1;
  if (*p != '\\') return 0;
  const size_t newline = nsvcd__text_newline(p + 1, end);
  return newline > 0 ? 1 + newline : 0;
}
static int nsvcd__text_is_digit(const nsvcd__text *t) {
  return t->at < t->end && *t->at >= '0' && *t->at <= '9';
}
static int nsvcd__text_accept(nsvcd__text *t, char c) {
  const int is_there = t->at < t->end && *t->at == c;
  if (is_there) t->at++;
  return is_there;
}
static int nsvcd__text_line_ends(const nsvcd__text *t) {
  return t->at == t->end || *t->at == '\n' || *t->at == '\r';
}
// Reads digits; returns 0 if there are none. The number saturates, above any limit.
static int nsvcd__text_integer(nsvcd__text *t, int64_t *number) {
  const char *start = t->at;
  for (*number = 0; nsvcd__text_is_digit(t); t->at++) {
    if (*number < 1000000000000000) *number = 10 * *number + (*t->at - '0');
  }
  return t->at > start;
}
static int nsvcd__text_token_ends(const nsvcd__text *t) {
  if (nsvcd__text_line_ends(t)) return 1;
  return nsvcd__text_blank(t->at, t->end) > 0;
}
static inline void nsvcd__text_skip_token(nsvcd__text *t) {
  for (; !nsvcd__text_token_ends(t); t->at++) {
    // a fast path over characters that end no token
    while (t->at + 1 < t->end && (unsigned char)t->at[1] > ' ' && t->at[1] != '\\') t->at++;
  }
}

// Skips blanks. Returns 0 at the end of the statement.
static int nsvcd__text_has_token(nsvcd__text *t) {
  size_t blank = nsvcd__text_blank(t->at, t->end);
  while (blank > 0) {
    t->line += blank > 1;
    t->at += blank;
    blank = nsvcd__text_blank(t->at, t->end);
  }
  return !nsvcd__text_line_ends(t) && *t->at != '#';
}

// mantissa * 10^exponent, exponent in -400..400. Powers up to 10^22 are exact, so there is usually
// a single rounding.
static double nsvcd__text_scale(uint64_t mantissa, int exponent) {
  static const double power[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  double value = (double)mantissa;
  for (; exponent > 22; exponent -= 22) value *= power[22];
  for (; exponent < -22; exponent += 22) value /= power[22];
  return exponent < 0 ? value / power[-exponent] : value * power[exponent];
}

// Accepts a sign; returns 1 if it is a minus.
static int nsvcd__text_minus(nsvcd__text *t) {
  const int minus = nsvcd__text_accept(t, '-');
  if (!minus) nsvcd__text_accept(t, '+');
  return minus;
}

// Reads a decimal number. Its relative error is at most 2^-52, and a few times that where the
// exponent is beyond +-22: rounded to float it is the nearest one, except for ties. NUMBER if it is
// infinite or NaN as printf writes them (nan, -nan(ind), inf, 1.#QNAN).
static nsvcd_result nsvcd__text_number(nsvcd__text *t, double *value) {
  const int negative = nsvcd__text_minus(t);
  if (t->at < t->end && strchr("nNiI", *t->at) && *t->at) return NSVCD_ERROR_NUMBER;
  // digits and a point: mantissa * 10^exponent
  uint64_t mantissa = 0;
  int64_t exponent = 0;
  int digits = 0;
  for (int point = 0;; t->at++) {
    if (!point && nsvcd__text_accept(t, '.')) point = 1;
    if (!nsvcd__text_is_digit(t)) break;
    digits = 1;
    // 19 digits are kept, the rest only move the point
    const int fits = mantissa < 1000000000000000000u;
    if (fits) mantissa = 10 * mantissa + (uint64_t)(*t->at - '0');
    exponent += !fits - point;
  }
  if (!digits) return NSVCD_ERROR_SYNTAX;
  if (t->at[-1] == '.' && nsvcd__text_accept(t, '#')) return NSVCD_ERROR_NUMBER;
  if (nsvcd__text_accept(t, 'e') || nsvcd__text_accept(t, 'E')) {
    const int minus = nsvcd__text_minus(t);
    int64_t written;
    if (!nsvcd__text_integer(t, &written)) return NSVCD_ERROR_SYNTAX;
    exponent += minus ? -written : written;
  }
  if (!nsvcd__text_token_ends(t)) return NSVCD_ERROR_SYNTAX;
  if (mantissa == 0) exponent = 0;
  if (exponent > 400) return NSVCD_ERROR_NUMBER;
  const int power = exponent < -400 ? -400 : (int)exponent;
  const double magnitude = nsvcd__text_scale(mantissa, power);
  *value = negative ? -magnitude : magnitude;
  return NSVCD_OK;
}

static void nsvcd__text_begin(nsvcd__text *t, const char *text, size_t size) {
  memset(t, 0, sizeof *t);
  t->at = text;
  t->end = text + size;
  // UTF-8 byte order mark
  if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) t->at += 3;
}
#endif  // NSVCD_NO_READERS
