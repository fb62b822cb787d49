// load.h - files that a person names, OBJ and .body, with messages that say what is wrong with
// them. Include neuralsvcd.h and problem_file.h first.
#ifndef NSVCD_SCENERY_LOAD_H
#define NSVCD_SCENERY_LOAD_H

#include "mesh_check.h"

// ------------------------------------------------------------------------------------------ meshes

// What a result says; where a number is too large, the limit.
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

// The text of a line, up to 60 characters of it; "" where it cannot be read again.
static void quote_line(const char *path, size_t line, char *out, size_t size) {
  FILE *file = fopen(path, "r");
  int c = file ? getc(file) : EOF;
  size_t n = 0;
  for (size_t at = 1; c != EOF && at <= line; c = getc(file)) {
    if (at == line && c != '\n' && c != '\r' && n + 1 < size) out[n++] = (char)(c < 32 ? ' ' : c);
    at += c == '\n';
  }
  out[n] = 0;
  if (file) fclose(file);
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

// Formats that people have, and svcd does not read.
static const char *foreign(const char *path) {
  static const char *const ends[] = {".ply", ".glb",  ".gltf", ".fbx", ".dae",
                                     ".3ds", ".step", ".stp",  ".usd"};
  const char *dot = strrchr(path, '.');
  for (size_t i = 0; dot && i < sizeof ends / sizeof ends[0]; i++)
    if (strcmp(dot, ends[i]) == 0) return ends[i];
  return NULL;
}

static int is_stl(const char *path) {
  const size_t length = strlen(path);
  const char *end = path + length - 4;
  return length > 4 && end[0] == '.' && (end[1] | 32) == 's' && (end[2] | 32) == 't' &&
         (end[3] | 32) == 'l';
}

// `from`: what asks for it, for messages ("file:line: "), or "". Returns 0 after a complaint.
static int load_mesh(const char *from, const char *path, nsvcd_mesh *mesh) {
  size_t line = 0;
  char text[61];
  const nsvcd_result result = is_stl(path) ? nsvcd_stl_load(path, NULL, mesh, &line)
                                           : nsvcd_obj_load(path, NULL, mesh, &line);
  if (!result) return 1;
  if (result != NSVCD_ERROR_IO && foreign(path))
    return complain(
        "%s%s: svcd reads OBJ, STL and .body files, no %s: convert it, as with Blender or "
        "'assimp export'",
        from, path, foreign(path));
  if (!line) return complain("%s%s: %s", from, path, reason_of(result));
  quote_line(path, line, text, sizeof text);
  return complain("%s%s:%zu: %s: '%s'", from, path, line, reason_of(result), text);
}

// Loads and encodes one mesh; nsvcd_body_free gives the body back.
static const nsvcd_body *encode_mesh(const char *from, const char *path, const nsvcd_mesh *mesh,
                                     const nsvcd_encode_options *options, double *taken) {
  const nsvcd_body *body = NULL;
  const double start = seconds();
  const nsvcd_result result = nsvcd_encode(mesh, options, NULL, NULL, 0, &body);
  *taken = seconds() - start;
  if (result) complain("%s%s: %s", from, path, reason_of(result));
  return body;
}

// Where a mesh is that a file names, by its path from that file's folder.
static void path_of(const char *file, const char *name, char *path, size_t size) {
  const size_t folder = (size_t)(file_name(file) - file);
  snprintf(path, size, "%.*s%s", name[0] == '/' ? 0 : (int)folder, file, name);
}

// A mesh, and its tree.
typedef struct proof_mesh {
  nsvcd_mesh mesh;
  void *memory;
  const nsvcd_tree *tree;
} proof_mesh;

// That a file names. Returns 0 after a complaint.
static int load_tree(const char *file, const char *name, proof_mesh *out) {
  char path[4096];
  path_of(file, name, path, sizeof path);
  if (!load_mesh("", path, &out->mesh)) return 0;
  const size_t size = nsvcd_tree_size(&out->mesh);
  out->memory = allocate(size);
  const nsvcd_result result = nsvcd_tree_build(&out->mesh, out->memory, size, &out->tree);
  return result ? complain("%s: %s", path, reason_of(result)) : 1;
}
static void free_tree(proof_mesh *mesh) {
  nsvcd_mesh_free(&mesh->mesh, NULL);
  free(mesh->memory);
}

// Loaded and encoded.
static const nsvcd_body *encode_named(const char *from, const char *file, const char *name,
                                      const nsvcd_encode_options *options, double *taken) {
  char path[4096];
  nsvcd_mesh mesh;
  path_of(file, name, path, sizeof path);
  if (!load_mesh(from, path, &mesh)) return NULL;
  const nsvcd_body *body = encode_mesh(from, path, &mesh, options, taken);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}

// ------------------------------------------------------------------------------------------ things

// "0.001", or "0.001,1" where two files are given: of each. 0 after a complaint.
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
  const char *path;
  nsvcd_mesh mesh;  // metres; of a .body file none
  mesh_report report;
  char faults[MESH_FINDINGS][MESH_LINE];
  int fault_count, grave;  // so many, the first ones, can change an answer
  char *memory;            // of a .body file
  const nsvcd_body *body;
  double taken;            // seconds, by encoding
  float scale;             // for the question: 1 where the mesh is in metres already
  double low[3], high[3];  // metres
} thing;

static void free_thing(thing *t) {
  nsvcd_mesh_free(&t->mesh, NULL);
  if (t->memory)
    free(t->memory);
  else
    nsvcd_body_free(t->body, NULL);
}

// Loads an OBJ, says what is wrong with it, and takes it to metres. Returns 0 after a complaint.
static int load_obj(const char *path, float scale, thing *t) {
  memset(t, 0, sizeof *t);
  t->path = path;
  t->scale = 1;
  if (!load_mesh("", path, &t->mesh)) return 0;
  if (!mesh_check(&t->mesh, (double)scale, &t->report)) return complain("out of memory");
  t->fault_count = mesh_findings(&t->report, t->faults, &t->grave);
  for (size_t i = 0; i < 3 * t->mesh.vertex_count; i++) t->mesh.positions[i] *= scale;
  memcpy(t->low, t->report.low, sizeof t->low);
  memcpy(t->high, t->report.high, sizeof t->high);
  return 1;
}

// Is it closed, all of it, and the right way out? Of a .body file that is not known.
static int is_solid(const thing *t) {
  return !t->memory && t->report.closed == t->report.components && t->report.volume > 0;
}

// Makes the body. Returns 0 after a complaint.
static int encode_thing(thing *t, const nsvcd_encode_options *options) {
  t->body = encode_mesh("", t->path, &t->mesh, options, &t->taken);
  if (!t->body) return 0;
  const nsvcd_body_facts facts = nsvcd_body_describe(t->body);
  t->fault_count += mesh_find_large(&t->mesh, &facts, t->faults[t->fault_count]);
  return 1;
}

static void warn_of(const thing *t, int count) {
  for (int i = 0; i < count; i++) complain("warning: %s: %s", t->path, t->faults[i]);
}

static int ends_with(const char *text, const char *end) {
  size_t n = strlen(text);
  size_t m = strlen(end);
  return n >= m && strcmp(text + n - m, end) == 0;
}

static int is_body_file(const char *path) {
  char begin[4] = "";
  FILE *file = fopen(path, "rb");
  const size_t size = file ? fread(begin, 1, sizeof begin, file) : 0;
  if (file) fclose(file);
  const int is_blob = memcmp(begin, "NSVB", 4) == 0 || memcmp(begin, "BVSN", 4) == 0;
  return ends_with(path, ".body") || (size == 4 && is_blob);
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
// Returns 0 after a complaint.
static int load_body(const char *path, float scale, thing *t) {
  size_t size;
  memset(t, 0, sizeof *t);
  t->path = path;
  t->scale = scale;
  t->memory = read_file(path, &size);
  if (!t->memory) return 0;
  const nsvcd_result result = nsvcd_body_load(t->memory, size, &t->body);
  if (result && has_other_byte_order(t->memory, size))
    return complain("%s: encoded on a machine of the other byte order", path);
  if (result) return complain("%s: %s", path, reason_of(result));
  box_of_balls(t);
  return 1;
}

// Returns 0 after a complaint.
static int load_thing(const char *path, float scale, const nsvcd_encode_options *options,
                      thing *t) {
  if (is_body_file(path)) return load_body(path, scale, t);
  const int good = load_obj(path, scale, t) && encode_thing(t, options);
  warn_of(t, t->grave);
  return good;
}

#endif
