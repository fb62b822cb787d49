// load.h - files that a person names, meshes and .body, with messages that say what is wrong with
// them. Include neuralsvcd.h and problem_file.h first.
#ifndef NSVCD_SCENERY_LOAD_H
#define NSVCD_SCENERY_LOAD_H

#include "mesh_check.h"
#include "mesh_files.h"

// ------------------------------------------------------------------------------------------ meshes

// What a result says; if a number is too large, with the limit.
static const char *reason_of(nsvcd_result result) {
  static char text[160];
  snprintf(text, sizeof text, "%s", nsvcd_result_string(result));
  if (result == NSVCD_ERROR_NUMBER)
    snprintf(text, sizeof text, "%s (NSVCD_MAX_COORDINATE: %g)", nsvcd_result_string(result),
             (double)NSVCD_MAX_COORDINATE);
  if (result == NSVCD_ERROR_SCALE)
    snprintf(text, sizeof text, "%s: %g to %g (NSVCD_MIN_SCALE, NSVCD_MAX_SCALE)",
             nsvcd_result_string(result), (double)NSVCD_MIN_SCALE, (double)NSVCD_MAX_SCALE);
  return text;
}

// The text of a line, up to 60 characters of it.
static void quote_line(const char *text, size_t size, size_t line, char *out, size_t room) {
  size_t n = 0;
  for (size_t i = 0, at = 1; i < size && at <= line; i++) {
    const char c = text[i];
    const int is_end = c == '\n' || (c == '\r' && (i + 1 == size || text[i + 1] != '\n'));
    if (at == line && !is_end && c != '\r' && n + 1 < room) out[n++] = c == '\t' ? ' ' : c;
    at += (size_t)is_end;
  }
  out[n] = 0;
}

// What follows the folder in a path.
static const char *file_name(const char *path) {
#if defined(_WIN32)
  const char *ends = "/\\";
#else
  const char *ends = "/";
#endif
  const char *name = path;
  for (; *path; path++)
    if (strchr(ends, *path)) name = path + 1;
  return name;
}

// Refuses by its beginning what is neither a mesh nor a body, before all of it is read.
static int look_at_mesh(const char *from, const char *path, const char *bytes, size_t size) {
  char ending[8];
  const char *format = mesh_format(path, (const unsigned char *)bytes, size);
  size_t zeros = 0;
  while (zeros < size && bytes[zeros] == 0) zeros++;
  mesh_ending(path, ending);
  if (zeros > 84) return complain("%s%s: it begins with zeros, as no mesh does", from, path);
  const int is_obj = format && strcmp(format, "OBJ") == 0;
  if (is_obj && strcmp(ending, "obj") == 0 && memchr(bytes, 0, size))
    return complain("%s%s: not a text file, as an OBJ is: it has a zero byte", from, path);
  return 1;
}

// A mesh of the bytes of a file. `from`: what asks for it, for messages ("file:line: "), or "".
// given: NULL, or by the options --scale and --recentre. Returns its format, or NULL after a
// complaint.
static const char *parse_mesh(const char *from, const char *path, const char *bytes, size_t size,
                              const nsvcd_mesh_options *given, nsvcd_mesh *mesh) {
  mesh_fault fault;
  char text[61];
  const char *of = "";
  if (mesh_parse_to(path, bytes, size, given, NULL, mesh, &fault)) return fault.format;
  if (strcmp(fault.reason, nsvcd_result_string(NSVCD_ERROR_NUMBER)) == 0)
    of = given ? " (NSVCD_MAX_COORDINATE): --scale 0.001 is of millimetres, --recentre of a map"
               : reason_of(NSVCD_ERROR_NUMBER) + strlen(fault.reason);
  if (!fault.line) {
    complain("%s%s: %s%s (read as %s)", from, path, fault.reason, of, fault.format);
    return NULL;
  }
  quote_line(bytes, size, fault.line, text, sizeof text);
  complain("%s%s:%zu: %s%s: '%s'", from, path, fault.line, fault.reason, of, text);
  return NULL;
}

// Loads the mesh of a file, in metres. Returns its format, or NULL after a complaint.
static const char *load_mesh(const char *from, const char *path, nsvcd_mesh *mesh) {
  size_t size;
  char *bytes = read_file(from, path, &size, look_at_mesh);
  const char *format = bytes ? parse_mesh(from, shown_name(path), bytes, size, NULL, mesh) : NULL;
  free(bytes);
  return format;
}

// Says on a terminal that a mesh is being encoded, if it takes about a second or more.
static progress_bar tell_encoding(const char *path, size_t triangles) {
  progress_bar working = {"", 0, 0, 0};
  if (triangles > 100000 && is_terminal()) {
    working.is_told = 1;
    fprintf(stderr, PROGRAM ": encoding %.30s ...", file_name(path));
  }
  return working;
}

// Loads and encodes one mesh; nsvcd_body_free gives the body back. With options->open it is a sheet
// if it is not closed, and only then.
static const nsvcd_body *encode_mesh(const char *from, const char *path, const nsvcd_mesh *mesh,
                                     const nsvcd_encode_options *options, double *taken) {
  const nsvcd_body *body = NULL;
  const progress_bar working = tell_encoding(path, mesh->triangle_count);
  const double start = seconds();
  nsvcd_encode_options asked;
  memset(&asked, 0, sizeof asked);
  if (options) asked = *options;
  asked.open = 0;
  nsvcd_result result = nsvcd_encode(mesh, &asked, NULL, NULL, 0, &body);
  if (!result && options && options->open && nsvcd_body_describe(body).open_components > 0) {
    nsvcd_body_free(body, NULL);
    body = NULL;
    asked.open = 1;
    result = nsvcd_encode(mesh, &asked, NULL, NULL, 0, &body);
  }
  *taken = seconds() - start;
  progress_end(&working);
  if (result) complain("%s%s: %s", from, path, reason_of(result));
  return body;
}

// The path of a mesh that a file names, which is from that file's folder.
static void path_of(const char *file, const char *name, char *path, size_t size) {
  const size_t folder = (size_t)(file_name(file) - file);
  snprintf(path, size, "%.*s%s", name[0] == '/' ? 0 : (int)folder, file, name);
}

// Scales a mesh along x, y, z, in double. If that mirrors it, it is turned the right way out again.
static void scale_mesh(nsvcd_mesh *mesh, const double scale[3]) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    mesh->positions[i] = (float)((double)mesh->positions[i] * scale[i % 3]);
  if (scale[0] * scale[1] * scale[2] > 0) return;
  for (uint32_t *t = mesh->indices; t < mesh->indices + 3 * mesh->triangle_count; t += 3) {
    const uint32_t second = t[1];
    t[1] = t[2];
    t[2] = second;
  }
}

// A mesh, and its tree.
typedef struct proof_mesh {
  nsvcd_mesh mesh;
  void *memory;
  const nsvcd_tree *tree;
} proof_mesh;

static int build_tree(const char *path, proof_mesh *out) {
  const size_t size = nsvcd_tree_size(&out->mesh);
  out->memory = allocate(size);
  const nsvcd_result result = nsvcd_tree_build(&out->mesh, out->memory, size, &out->tree);
  return result ? complain("%s: %s", path, reason_of(result)) : 1;
}

// Loads a mesh that a file names, scaled (NULL: as it is), and makes its tree. Returns 0 after a
// complaint.
static int load_tree(const char *file, const char *name, const double *scale, proof_mesh *out) {
  char path[4096];
  path_of(file, name, path, sizeof path);
  const char *format = load_mesh("", path, &out->mesh);
  if (!format) return 0;
  if (strcmp(format, "OBJ") != 0 && strcmp(format, "STL") != 0)
    return complain("%s: a %s: certificates are of OBJ and STL, as build/verify reads no other",
                    path, format);
  if (scale) scale_mesh(&out->mesh, scale);
  return build_tree(path, out);
}
static void free_tree(proof_mesh *mesh) {
  nsvcd_mesh_free(&mesh->mesh, NULL);
  free(mesh->memory);
}

// Loads and encodes a mesh that a file names, scaled (NULL: as it is).
static const nsvcd_body *encode_named(const char *from, const char *file, const char *name,
                                      const double *scale, const nsvcd_encode_options *options,
                                      double *taken) {
  char path[4096];
  nsvcd_mesh mesh;
  path_of(file, name, path, sizeof path);
  if (!load_mesh(from, path, &mesh)) return NULL;
  if (scale) scale_mesh(&mesh, scale);
  const nsvcd_body *body = encode_mesh(from, path, &mesh, options, taken);
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  char line[MESH_LINE];
  if (mesh_find_open(&facts, line)) complain("warning: %s: %s", path, line);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}

// ------------------------------------------------------------------------------------------ things

// Takes the scales "0.001", or, of two files, "0.001,1". Returns 0 after a complaint.
static int take_scales(const char *text, size_t count, float *scales) {
  char copy[64];
  const char *comma = text ? strchr(text, ',') : NULL;
  const char *second = comma ? comma + 1 : text;
  scales[0] = scales[1] = 1;
  if (!text) return 1;
  snprintf(copy, sizeof copy, "%.*s", comma ? (int)(comma - text) : 63, text);
  int good =
      (!comma || count == 2) && parse_float(copy, &scales[0]) && parse_float(second, &scales[1]);
  for (int i = 0; i < 2; i++)
    good = good && scales[i] >= NSVCD_MIN_SCALE && scales[i] <= NSVCD_MAX_SCALE;
  if (!good)
    complain("--scale %s: not a number in %g..%g%s", text, (double)NSVCD_MIN_SCALE,
             (double)NSVCD_MAX_SCALE, count == 2 ? ", nor one for A and one for B: 0.001,1" : "");
  return good;
}

// A file that was given: a mesh and the body that is made of it, or a .body file.
typedef struct thing {
  const char *path;  // its name, as it is shown
  char *bytes;       // the file's; a mesh has them only until it is loaded
  size_t size;
  int is_body;
  const char *format;  // a mesh's
  nsvcd_mesh mesh;     // metres
  mesh_report report;
  char faults[MESH_FINDINGS][MESH_LINE];
  int fault_count, grave;  // grave: how many of them, the first ones, can change an answer
  const nsvcd_body *body;
  double taken;            // seconds, by encoding
  int recentre;            // a mesh: the middle of its box is to be the origin
  double origin[3];        // the point that became the origin, in the file's units
  float scale;             // for the question: 1 where the mesh is in metres already
  double low[3], high[3];  // metres
} thing;

static void free_thing(thing *t) {
  nsvcd_mesh_free(&t->mesh, NULL);
  if (!t->is_body) nsvcd_body_free(t->body, NULL);
  free(t->bytes);
}

static int ends_with(const char *text, const char *end) {
  size_t n = strlen(text);
  size_t m = strlen(end);
  return n >= m && strcmp(text + n - m, end) == 0;
}

// Reads a file, and tells by its beginning or its name whether it is a body. Returns 0 after a
// complaint.
static int open_thing(const char *path, thing *t) {
  memset(t, 0, sizeof *t);
  t->path = shown_name(path);
  t->scale = 1;
  t->bytes = read_file("", path, &t->size, ends_with(path, ".body") ? NULL : look_at_mesh);
  if (!t->bytes) return 0;
  t->is_body =
      ends_with(path, ".body") ||
      (t->size >= 4 && (memcmp(t->bytes, "NSVB", 4) == 0 || memcmp(t->bytes, "BVSN", 4) == 0));
  return 1;
}

// The middle of the box of a mesh's vertices, in whole units of the file. Returns 0 after a
// complaint.
static int find_middle(const thing *t, double *middle) {
  nsvcd_mesh mesh;
  nsvcd_mesh_options tiny;
  memset(&tiny, 0, sizeof tiny);
  tiny.scale = 1e-30;  // whatever the coordinates, they are within bounds
  if (!parse_mesh("", t->path, t->bytes, t->size, &tiny, &mesh)) return 0;
  for (size_t k = 0; k < 3; k++) {
    float low = mesh.positions[k];
    float high = low;
    for (size_t i = 1; i < mesh.vertex_count; i++) {
      low = fminf(low, mesh.positions[3 * i + k]);
      high = fmaxf(high, mesh.positions[3 * i + k]);
    }
    middle[k] = floor(((double)low + (double)high) / 2 / tiny.scale + 0.5);
  }
  nsvcd_mesh_free(&mesh, NULL);
  return 1;
}

// Takes a mesh to metres, and says what is wrong with it. Returns 0 after a complaint.
static int take_mesh(thing *t, float scale) {
  nsvcd_mesh_options options;
  memset(&options, 0, sizeof options);
  options.scale = (double)scale;
  if (t->recentre && !find_middle(t, t->origin)) return 0;
  memcpy(options.origin, t->origin, sizeof options.origin);
  t->format = parse_mesh("", t->path, t->bytes, t->size, &options, &t->mesh);
  free(t->bytes);
  t->bytes = NULL;
  if (!t->format) return 0;
  if (!mesh_check(&t->mesh, 1, &t->report)) return complain("out of memory");
  t->report.scale = (double)scale;
  // drawn in millimetres by most
  if (strcmp(t->format, "STL") == 0) t->report.large = MESH_LARGE_STL;
  t->fault_count = mesh_findings(&t->report, t->faults, &t->grave);
  memcpy(t->low, t->report.low, sizeof t->low);
  memcpy(t->high, t->report.high, sizeof t->high);
  return 1;
}

// Is it closed, all of it, and the right way out? Of a .body file that is not known.
static int is_solid(const thing *t) {
  return !t->is_body && t->report.closed == t->report.components && t->report.volume > 0;
}

// Makes the body. Returns 0 after a complaint.
static int encode_thing(thing *t, const nsvcd_encode_options *options) {
  t->body = encode_mesh("", t->path, &t->mesh, options, &t->taken);
  if (!t->body) return 0;
  const nsvcd_body_facts facts = nsvcd_body_describe(t->body);
  char line[MESH_LINE];
  if (mesh_find_open(&facts, line)) {
    const size_t after = (size_t)(t->fault_count++ - t->grave);
    memmove(t->faults[t->grave + 1], t->faults[t->grave], after * MESH_LINE);
    memcpy(t->faults[t->grave++], line, sizeof line);
  }
  t->fault_count += mesh_find_large(&t->mesh, &facts, t->faults[t->fault_count]);
  if (facts.components > 0) {
    t->report.components = facts.components;
    t->report.closed = facts.components - facts.open_components;
  }
  return 1;
}

static void warn_of(const thing *t, int count) {
  for (int i = 0; i < count; i++) complain("warning: %s: %s", t->path, t->faults[i]);
}

// A blob begins with "NSVB", or, from a big-endian machine, with "BVSN".
static int has_other_byte_order(const void *memory, size_t size) {
  const uint16_t one = 1;
  const char *other = *(const char *)&one ? "BVSN" : "NSVB";
  return size >= 4 && memcmp(memory, other, 4) == 0;
}

// The box about the balls of a body's patches.
static void box_of_balls(thing *t) {
  float centre[3], radius;
  for (size_t k = 0; k < 3; k++) {
    t->low[k] = HUGE_VAL;
    t->high[k] = -HUGE_VAL;
  }
  for (uint32_t i = 0; nsvcd_body_patch(t->body, i, centre, &radius); i++)
    for (size_t k = 0; k < 3; k++) {
      t->low[k] = fmin(t->low[k], (double)t->scale * (double)(centre[k] - radius));
      t->high[k] = fmax(t->high[k], (double)t->scale * (double)(centre[k] + radius));
    }
}
// Makes a thing of a .body file. Returns 0 after a complaint.
static int take_body(thing *t, float scale) {
  t->scale = scale;
  const nsvcd_result result = nsvcd_body_load(t->bytes, t->size, &t->body);
  if (result && has_other_byte_order(t->bytes, t->size))
    return complain("%s: encoded on a machine of the other byte order", t->path);
  if (result) return complain("%s: %s", t->path, reason_of(result));
  box_of_balls(t);
  const nsvcd_body_facts facts = nsvcd_body_describe(t->body);
  t->fault_count = t->grave = mesh_find_open(&facts, t->faults[0]);
  return 1;
}

// Makes a thing of a file that has been read. Returns 0 after a complaint.
static int take_thing(thing *t, float scale, const nsvcd_encode_options *options) {
  return t->is_body ? take_body(t, scale) : take_mesh(t, scale) && encode_thing(t, options);
}

#endif
