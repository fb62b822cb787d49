// json_read.h - JSON (RFC 8259) as a flat array of values. Include mesh_soup.h first.
//
// A value knows where the one behind it begins, so that members are walked without pointers:
//   for (size_t i = json_first(j, object); i < j->values[object].next; i = j->values[i].next)
// Members of an object are two values each, key and value. Strings stay as they are written.
#ifndef NSVCD_SCENERY_JSON_READ_H
#define NSVCD_SCENERY_JSON_READ_H

#define JSON_DEPTH 64
#define JSON_NONE SIZE_MAX

typedef struct json_value {
  char kind;  // { [ " 0 (a number), t f n
  const char *at;
  size_t length;  // a string's, without its quotes
  size_t next;    // the value behind this one and all that is in it
} json_value;

typedef struct json {
  const char *at, *end;
  json_value *values;
  size_t count, room;
} json;

static inline void json_blanks(json *j) {
  while (j->at < j->end && memchr(" \t\r\n", *j->at, 4)) j->at++;
}
static inline int json_accept(json *j, char c) {
  json_blanks(j);
  const int is_there = j->at < j->end && *j->at == c;
  j->at += is_there;
  return is_there;
}

// A string behind its first quote.
static inline int json_string(json *j, json_value *value) {
  value->at = j->at;
  for (; j->at < j->end && *j->at != '"'; j->at++) {
    if ((unsigned char)*j->at < ' ') return 0;
    if (*j->at == '\\' && ++j->at == j->end) return 0;
  }
  value->length = (size_t)(j->at - value->at);
  return json_accept(j, '"');
}

static inline int json_take(json *j, int depth);

static inline int json_members(json *j, int is_object, int depth) {
  const char end = is_object ? '}' : ']';
  if (json_accept(j, end)) return 1;
  do {
    json_blanks(j);
    if (is_object && (j->at == j->end || *j->at != '"')) return 0;
    if (!json_take(j, depth + 1)) return 0;
    if (is_object && !(json_accept(j, ':') && json_take(j, depth + 1))) return 0;
  } while (json_accept(j, ','));
  return json_accept(j, end);
}

static inline int json_literal(json *j, const char *word) {
  const size_t length = strlen(word);
  if ((size_t)(j->end - j->at) < length || memcmp(j->at, word, length) != 0) return 0;
  j->at += length;
  return 1;
}

// The next value, and all that is in it. 0 where it is none, or there is no memory.
static inline int json_take(json *j, int depth) {
  json_value value = {0, NULL, 0, 0};
  double unused;
  json_blanks(j);
  if (depth > JSON_DEPTH || j->at == j->end) return 0;
  if (!mesh_soup_grow(&j->values, j->count, &j->room, sizeof *j->values)) return 0;
  const size_t index = j->count++;
  value.kind = *j->at;
  value.at = j->at;
  int good;
  if (value.kind == '{' || value.kind == '[') {
    j->at++;
    good = json_members(j, value.kind == '{', depth);
  } else if (value.kind == '"') {
    j->at++;
    good = json_string(j, &value);
  } else if (value.kind == 't' || value.kind == 'f' || value.kind == 'n') {
    good = json_literal(j, value.kind == 't' ? "true" : value.kind == 'f' ? "false" : "null");
  } else {
    value.kind = '0';
    good = *j->at != '+' && *j->at != '.' && mesh_number(&j->at, j->end, &unused);
  }
  value.next = j->count;
  j->values[index] = value;
  return good;
}

// Reads a text. Returns 0 if it is no JSON, or there is no memory. Free j->values either way.
static inline int json_parse(json *j, const char *text, size_t size) {
  memset(j, 0, sizeof *j);
  j->at = text;
  j->end = text + size;
  if (!json_take(j, 0)) return 0;
  json_blanks(j);
  return j->at == j->end;
}

static inline int json_is(const json *j, size_t i, char kind) {
  return i != JSON_NONE && j->values[i].kind == kind;
}

// The value of a key of an object, or JSON_NONE, also of what is no object.
static inline size_t json_find(const json *j, size_t object, const char *key) {
  if (!json_is(j, object, '{')) return JSON_NONE;
  for (size_t i = object + 1; i < j->values[object].next; i = j->values[i + 1].next) {
    const json_value *name = &j->values[i];
    if (name->length == strlen(key) && memcmp(name->at, key, name->length) == 0) return i + 1;
  }
  return JSON_NONE;
}

// Item `index` of an array, or JSON_NONE. Takes time by the index.
static inline size_t json_item(const json *j, size_t array, size_t index) {
  if (!json_is(j, array, '[')) return JSON_NONE;
  for (size_t i = array + 1; i < j->values[array].next; i = j->values[i].next) {
    if (index-- == 0) return i;
  }
  return JSON_NONE;
}

// A number; `otherwise` where there is none.
static inline double json_number(const json *j, size_t i, double otherwise) {
  double value = otherwise;
  const char *at = json_is(j, i, '0') ? j->values[i].at : NULL;
  if (at) mesh_number(&at, j->end, &value);
  return value;
}

// A whole number in 0..2^53, or JSON_NONE.
static inline size_t json_whole(const json *j, size_t i) {
  const double value = json_number(j, i, -1);
  if (!(value >= 0 && value <= 9007199254740992.0) || value != floor(value)) return JSON_NONE;
  return value < (double)SIZE_MAX ? (size_t)value : JSON_NONE;
}

#endif
