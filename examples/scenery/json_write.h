// json_write.h - JSON, written value by value: a line an object. What is no number of JSON, NaN or
// infinite, is null. Include files.h first.
#ifndef NSVCD_SCENERY_JSON_WRITE_H
#define NSVCD_SCENERY_JSON_WRITE_H

typedef struct json_out {
  FILE *file;
  int follows;  // a value was written at this depth
} json_out;

// Writes what stands before a value. key: NULL in a list.
static void json_key(json_out *j, const char *key) {
  if (j->follows) fputs(", ", j->file);
  if (key) fprintf(j->file, "\"%s\": ", key);
  j->follows = 1;
}
// bracket: { or [.
static void json_open(json_out *j, const char *key, char bracket) {
  json_key(j, key);
  putc(bracket, j->file);
  j->follows = 0;
}
static void json_close(json_out *j, char bracket) {
  putc(bracket, j->file);
  j->follows = 1;
}
static void json_end_line(json_out *j) {
  json_close(j, '}');
  putc('\n', j->file);
  j->follows = 0;
}

static void json_text(json_out *j, const char *key, const char *text) {
  json_key(j, key);
  putc('"', j->file);
  while (*text) {
    const unsigned char *p = (const unsigned char *)text;
    const size_t length = shown_character(p);
    if (*p == '"' || *p == '\\') putc('\\', j->file);
    if (length) fwrite(text, 1, length, j->file);
    if (!length) fprintf(j->file, "\\u%04x", *p < 0x80 ? *p : 0xfffd);
    text += length ? length : 1;
  }
  putc('"', j->file);
}
// Digits: 9 for a float, 17 for a double.
static void json_digits(json_out *j, const char *key, double value, int digits) {
  json_key(j, key);
  if (fabs(value) <= DBL_MAX)
    fprintf(j->file, "%.*g", digits, value);
  else
    fputs("null", j->file);
}
static void json_float(json_out *j, const char *key, double value) {
  json_digits(j, key, value, 9);
}
static void json_count(json_out *j, const char *key, size_t count) {
  json_key(j, key);
  fprintf(j->file, "%zu", count);
}
static void json_flag(json_out *j, const char *key, int flag) {
  json_key(j, key);
  fputs(flag ? "true" : "false", j->file);
}
static void json_floats(json_out *j, const char *key, const float *values, size_t count) {
  json_open(j, key, '[');
  for (size_t k = 0; k < count; k++) json_float(j, NULL, (double)values[k]);
  json_close(j, ']');
}

#endif
