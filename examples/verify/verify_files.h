// SPDX-License-Identifier: MIT
// verify_files.h - of verify.c: reads OBJ and STL files and problem files (examples/FORMATS.md), as
// neuralsvcd.h and svcd do, by code of its own.
#ifndef NSVCD_VERIFY_FILES_H
#define NSVCD_VERIFY_FILES_H
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "nsvcd_verify_claim.h"

#define MOST_WORDS 300  // of a line

// An array that grows.
typedef struct list {
  void *items;
  size_t count, capacity;
} list;

static void fail(const char *path, const char *reason) {
  fprintf(stderr, "verify: %s: %s\n", path, reason);
  exit(2);
}

static void *allocate(size_t size) {
  void *memory = malloc(size ? size : 1);
  if (!memory) fail("memory", "there is none");
  return memory;
}

// Room for one more item at the end of a list.
static void *add(list *l, size_t size) {
  if (l->count == l->capacity) {
    l->capacity = l->capacity ? 2 * l->capacity : 256;
    l->items = realloc(l->items, l->capacity * size);
    if (!l->items) fail("memory", "there is none");
  }
  return (char *)l->items + size * l->count++;
}
static void add_float(list *l, double x) {
  *(float *)add(l, sizeof(float)) = (float)x;
}
static void add_index(list *l, uint32_t i) {
  *(uint32_t *)add(l, sizeof(uint32_t)) = i;
}

// Reads all bytes of a file, and puts a 0 behind them. Returns NULL if it cannot be read.
static char *read_file(const char *path, size_t *size) {
  list bytes = {NULL, 0, 0};
  FILE *file = fopen(path, "rb");
  if (!file) return NULL;
  for (int c = getc(file); c != EOF; c = getc(file)) *(char *)add(&bytes, 1) = (char)c;
  const int failed = ferror(file);
  fclose(file);
  *(char *)add(&bytes, 1) = 0;
  *size = bytes.count - 1;
  return failed ? NULL : (char *)bytes.items;
}

static void no_zero(const char *path, const char *text, size_t size) {
  if (memchr(text, 0, size)) fail(path, "a zero byte in a text");
}

// The next line of a text that has any words, cut into them; 0: there is none.
static size_t next_words(char **text, char **words, size_t most) {
  size_t count = 0;
  while (**text && count == 0) {
    char *line = *text;
    char *end = line + strcspn(line, "\r\n");
    // a backslash continues a line
    while (*end && end > line && end[-1] == '\\' && !memchr(line, '#', (size_t)(end - line))) {
      end[-1] = ' ';
      if (end[0] == '\r' && end[1] == '\n') *end++ = ' ';
      *end = ' ';
      end += strcspn(end, "\r\n");
    }
    *text = *end ? end + 1 : end;
    *end = 0;
    line[strcspn(line, "#")] = 0;
    for (char *word = strtok(line, " \t\v\f"); word; word = strtok(NULL, " \t\v\f")) {
      if (count == most) fail("a line", "it has too many words");
      words[count++] = word;
    }
  }
  return count;
}

static double number_of(const char *path, const char *word) {
  char *end;
  const double x = strtod(word, &end);
  if (end == word || *end || !verify__within_double(x, 3e38)) fail(path, "a number is none");
  return x;
}

// A pose, of a quaternion of any length, which is made unit in double.
static void read_pose(const char *path, char *const *words, float *pose) {
  double q[4], square = 0;
  for (size_t k = 0; k < 3; k++) pose[k] = (float)number_of(path, words[k]);
  for (size_t k = 0; k < 4; k++) {
    q[k] = number_of(path, words[3 + k]);
    square += q[k] * q[k];
  }
  for (size_t k = 0; k < 4; k++) pose[3 + k] = (float)(q[k] / sqrt(square));
}

// ---- OBJ

typedef struct corner {
  double x, y;
  uint32_t vertex, previous, next;
  int waits;
} corner;

static double turn_of(const corner *a, const corner *b, const corner *c) {
  return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}
static int same_place(const corner *a, const corner *b) {
  return !(a->x < b->x || a->x > b->x || a->y < b->y || a->y > b->y);
}

// Is corner i convex, and no reflex corner within its triangle?
static int is_ear(const corner *c, uint32_t i) {
  const corner *a = &c[c[i].previous];
  const corner *b = &c[i];
  const corner *d = &c[c[i].next];
  if (!(turn_of(a, b, d) > 0)) return 0;
  for (uint32_t k = d->next; k != c[i].previous; k = c[k].next) {
    const corner *p = &c[k];
    if (!(turn_of(&c[p->previous], p, &c[p->next]) < 0)) continue;
    if (same_place(p, a) || same_place(p, b) || same_place(p, d)) continue;
    if (turn_of(a, b, p) >= 0 && turn_of(b, d, p) >= 0 && turn_of(d, a, p) >= 0) return 0;
  }
  return 1;
}

// Puts the corners into a plane: drops the axis along which the polygon's normal is longest.
static void project(corner *c, uint32_t count, const float *positions) {
  const float *origin = positions + 3 * (size_t)c[0].vertex;
  double n[3] = {0, 0, 0};
  for (uint32_t i = 0; i < count; i++) {
    const float *p = positions + 3 * (size_t)c[i].vertex;
    const float *q = positions + 3 * (size_t)c[(i + 1) % count].vertex;
    for (int k = 0; k < 3; k++) {
      const int u = (k + 1) % 3;
      const int v = (k + 2) % 3;
      n[k] += ((double)p[u] - (double)origin[u]) * ((double)q[v] - (double)origin[v]) -
              ((double)p[v] - (double)origin[v]) * ((double)q[u] - (double)origin[u]);
    }
  }
  int axis = fabs(n[1]) > fabs(n[0]) ? 1 : 0;
  if (fabs(n[2]) > fabs(n[axis])) axis = 2;
  const int turned = n[axis] < 0;
  for (uint32_t i = 0; i < count; i++) {
    const float *p = positions + 3 * (size_t)c[i].vertex;
    c[i].x = (double)p[(axis + 1 + turned) % 3];
    c[i].y = (double)p[(axis + 2 - turned) % 3];
  }
}

// Cuts ears off a polygon, in the order of a queue of those that may be one (Meisters 1975).
static void triangulate(corner *c, uint32_t count, const float *positions, list *indices) {
  uint32_t *queue = (uint32_t *)allocate(count * sizeof *queue);
  size_t first = 0;
  size_t length = count;
  uint32_t at = 0;
  for (uint32_t i = 0; i < count; i++) {
    c[i].previous = (i + count - 1) % count;
    c[i].next = (i + 1) % count;
    c[i].waits = 1;
    queue[i] = i;
  }
  if (count > 3) project(c, count, positions);
  for (uint32_t left = count; left > 3;) {
    const int stuck = length == 0;
    const uint32_t i = stuck ? at : queue[first];
    if (!stuck) {
      first = (first + 1) % count;
      length--;
      c[i].waits = 0;
      if (!is_ear(c, i)) continue;
    }
    const uint32_t beside[2] = {c[i].previous, c[i].next};
    add_index(indices, c[beside[0]].vertex);
    add_index(indices, c[i].vertex);
    add_index(indices, c[beside[1]].vertex);
    c[beside[0]].next = beside[1];
    c[beside[1]].previous = beside[0];
    for (int k = 0; k < 2; k++) {
      if (!c[beside[k]].waits) queue[(first + length++) % count] = beside[k];
      c[beside[k]].waits = 1;
    }
    at = beside[1];
    left--;
  }
  add_index(indices, c[at].vertex);
  add_index(indices, c[c[at].next].vertex);
  add_index(indices, c[c[at].previous].vertex);
  free(queue);
}

#define MOST_CORNERS 65536
static void read_obj(const char *path, char *text, list *positions, list *indices) {
  char **words = (char **)allocate(MOST_CORNERS * sizeof *words);
  list corners = {NULL, 0, 0};
  list sizes = {NULL, 0, 0};
  for (size_t n = next_words(&text, words, MOST_CORNERS); n > 0;
       n = next_words(&text, words, MOST_CORNERS)) {
    const int is_vertex = strcmp(words[0], "v") == 0;
    if (is_vertex && n < 4) fail(path, "a vertex has fewer than three numbers");
    for (size_t k = 1; k < 4 && is_vertex; k++) add_float(positions, number_of(path, words[k]));
    if (strcmp(words[0], "f") != 0) continue;
    add_index(&sizes, (uint32_t)(n - 1));
    for (size_t k = 1; k < n; k++) {
      char *end;
      const long long at = strtoll(words[k], &end, 10);
      const long long before = (long long)(positions->count / 3);
      if (end == words[k] || (*end && *end != '/') || at == 0 || at > 0x60000000 || at < -before)
        fail(path, "a corner of a face is none");
      add_index(&corners, (uint32_t)(at < 0 ? before + at : at - 1));
    }
  }
  const uint32_t *vertex = (const uint32_t *)corners.items;
  for (size_t f = 0; f < sizes.count; f++) {
    const uint32_t count = ((const uint32_t *)sizes.items)[f];
    corner *polygon = (corner *)allocate(count * sizeof *polygon);
    for (uint32_t i = 0; i < count; i++) {
      polygon[i].vertex = *vertex++;
      if (polygon[i].vertex >= positions->count / 3) fail(path, "an index is out of range");
    }
    if (count < 3) fail(path, "a face has fewer than three corners");
    triangulate(polygon, count, (const float *)positions->items, indices);
    free(polygon);
  }
  free(words);
  free(corners.items);
  free(sizes.items);
}

// ---- STL

// Makes one vertex of corners at the same place, in the order in which they come first.
static void weld(list *positions, list *indices) {
  float *x = (float *)positions->items;
  const size_t corners = positions->count / 3;
  const size_t slots = 2 * corners + 1;
  uint32_t *table = (uint32_t *)allocate(slots * sizeof *table);
  size_t vertices = 0;
  memset(table, 0xff, slots * sizeof *table);
  for (size_t i = 0; i < corners; i++) {
    float at[3];
    for (int k = 0; k < 3; k++) at[k] = x[3 * i + (size_t)k] + 0.0f;  // no -0
    size_t slot = verify__hash(0, at, 3) % slots;
    while (table[slot] != 0xffffffffu && memcmp(x + 3 * (size_t)table[slot], at, sizeof at) != 0)
      slot = (slot + 1) % slots;
    if (table[slot] == 0xffffffffu) {
      memcpy(x + 3 * vertices, at, sizeof at);
      table[slot] = (uint32_t)vertices++;
    }
    add_index(indices, table[slot]);
  }
  positions->count = 3 * vertices;
  free(table);
}

static void read_stl(const char *path, char *text, size_t size, list *positions, list *indices) {
  uint32_t told = 0;
  const unsigned char *bytes = (const unsigned char *)text;
  for (size_t k = 0; k < 4 && size >= 84; k++) told |= (uint32_t)bytes[80 + k] << (8 * k);
  const char *start = text + strspn(text, " \t\r\n\v\f");
  const int is_solid = (start[0] | 32) == 's' && (start[1] | 32) == 'o' && (start[2] | 32) == 'l' &&
                       (start[3] | 32) == 'i' && (start[4] | 32) == 'd';
  if (size == 84 + 50 * (size_t)told || !is_solid) {
    if (size < 84 || (size - 84) / 50 < told) fail(path, "it ends early");
    for (size_t i = 0; i < 9 * (size_t)told; i++) {
      const unsigned char *p = bytes + 84 + i / 9 * 50 + 12 + i % 9 * 4;
      const uint32_t word =
          p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
      float x;
      memcpy(&x, &word, sizeof x);
      add_float(positions, (double)x);
    }
  } else {
    char *words[MOST_WORDS];
    no_zero(path, text, size);
    for (size_t n = next_words(&text, words, MOST_WORDS); n > 0;
         n = next_words(&text, words, MOST_WORDS)) {
      const int is_vertex = (words[0][0] | 32) == 'v';
      if (is_vertex && n != 4) fail(path, "a vertex has other than three numbers");
      for (size_t k = 1; k < 4 && is_vertex; k++) add_float(positions, number_of(path, words[k]));
    }
  }
  if (positions->count % 9 != 0) fail(path, "it ends within a triangle");
  weld(positions, indices);
}

// Scales a mesh along x, y, z. If that mirrors it, it is turned the right way out again.
static void scale_mesh(list *positions, list *indices, const double *scale) {
  float *x = (float *)positions->items;
  uint32_t *t = (uint32_t *)indices->items;
  for (size_t i = 0; i < positions->count; i++) x[i] = (float)((double)x[i] * scale[i % 3]);
  for (size_t i = 0; i + 2 < indices->count && scale[0] * scale[1] * scale[2] < 0; i += 3) {
    const uint32_t second = t[i + 1];
    t[i + 1] = t[i + 2];
    t[i + 2] = second;
  }
}

// Builds the tree of a mesh; ends the program where that cannot be.
static void build_mesh(const char *path, const list *positions, const list *indices,
                       nsvcd_verify_mesh *mesh) {
  const size_t vertices = positions->count / 3;
  const size_t triangles = indices->count / 3;
  void *memory = allocate(NSVCD_VERIFY_MESH_BYTES(vertices, triangles));
  const char *why =
      nsvcd_verify_mesh_init((const float *)positions->items, vertices,
                             (const uint32_t *)indices->items, triangles, memory, mesh);
  if (why) fail(path, why);
}

// Reads a mesh, scales it (NULL: leaves it) and builds its tree; ends the program where that cannot be.
static void read_mesh(const char *path, const double *scale, nsvcd_verify_mesh *mesh) {
  size_t size;
  list positions = {NULL, 0, 0};
  list indices = {NULL, 0, 0};
  char *text = read_file(path, &size);
  if (!text) fail(path, strerror(errno));
  const size_t length = strlen(path);
  const int is_stl = length > 4 && (path[length - 3] | 32) == 's' &&
                     (path[length - 2] | 32) == 't' && (path[length - 1] | 32) == 'l';
  char *begin = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
  if (is_stl) read_stl(path, text, size, &positions, &indices);
  if (!is_stl) no_zero(path, text, size);
  if (!is_stl) read_obj(path, begin, &positions, &indices);
  if (scale) scale_mesh(&positions, &indices, scale);
  build_mesh(path, &positions, &indices, mesh);
  free(text);
}

// The path of a file that another one names, from that one's folder.
static void path_from(const char *file, const char *name, char *path, size_t size) {
  const char *slash = strrchr(file, '/');
  const int folder = name[0] == '/' || !slash ? 0 : (int)(slash + 1 - file);
  const int length = snprintf(path, size, "%.*s%s", folder, file, name);
  if (length < 0 || (size_t)length >= size) fail(name, "its path is too long");
}

// A mesh that a file names, by its path from that file's folder; kept until the program ends.
static const nsvcd_verify_mesh *mesh_of_file(const char *file, const char *name,
                                             const double *scale) {
  char path[4096];
  nsvcd_verify_mesh *mesh = (nsvcd_verify_mesh *)allocate(sizeof *mesh);
  path_from(file, name, path, sizeof path);
  read_mesh(path, scale, mesh);
  return mesh;
}
// What is asked for: which certificates, and of which problems.
typedef struct request {
  const char *folder;
  const char *only;  // ID,ID: these alone; NULL: all
  float clearance;
  size_t found;              // how many of those there were
  int pairs;                 // 1: of a robot's bodies, in place of plans
  int claims;                // 1: the claim of what is accepted is told
  nsvcd_verify_sha claimed;  // the claims that a certificate proves, one after the other
  uint8_t claim[32];         // the first, then, of several, their hash
} request;

static int is_wanted(request *asked, const char *id) {
  const size_t length = strlen(id);
  for (const char *at = asked->only; at && *at;) {
    const size_t word = strcspn(at, ",");
    if (word == length && strncmp(at, id, word) == 0) return ++asked->found, 1;
    at += word + (at[word] == ',');
  }
  return !asked->only;
}

// Adds the claim of two movers to those that a certificate proves.
static void note_claim(request *asked, const nsvcd_verify_mover *a, const nsvcd_verify_mover *b,
                       float clearance) {
  uint8_t claim[32];
  if (!asked->claims || !nsvcd_verify_claim(a, b, clearance, claim)) return;
  if (asked->claimed.size == 0) memcpy(asked->claim, claim, sizeof claim);
  nsvcd_verify_sha_add(&asked->claimed, claim, sizeof claim);
}

// Writes a certificate's line. why: NULL: it is accepted, and proves this; at: the byte where it is refused.
static void print_line(request *asked, const char *id, const char *why, const char *proven,
                       size_t size, size_t at, double taken) {
  if (!why) printf("%s\taccepted\t%s\t%zu\t%.1f", id, proven, size, taken);
  if (why && !size) printf("%s\trefused\t%s\t0\t0", id, why);
  if (why && size) printf("%s\trefused\t%s, at byte %zu\t%zu\t%.1f", id, why, at, size, taken);
  if (asked->claims) printf("\t");
  if (!why && asked->claimed.size > 32) nsvcd_verify_sha_end(&asked->claimed, asked->claim);
  for (int k = 0; k < 32 && asked->claims && !why; k++) printf("%02x", asked->claim[k]);
  printf("\n");
  nsvcd_verify_sha_begin(&asked->claimed);
}

#endif  // NSVCD_VERIFY_FILES_H
