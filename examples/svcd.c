// svcd.c - neuralsvcd.h on the command line: answers a file of problems, encodes a mesh, describes a body.
//
// `svcd` without arguments prints how to use it; FORMATS.md (problem files) is repeated in short below. Exit status: 0
// done, 1 a file or a line was refused (file, line and reason on standard error), 2 usage.
//
//   nsvcd-problems 1
//   mesh NAME PATH                        # OBJ, relative to the problem file
//   problem ID MOVING SCALE FIXED SCALE  x y z qx qy qz qw  LABEL MARGIN COUNT
//   x y z qx qy qz qw                     # COUNT lines: pose of the moving body at t = i/(COUNT-1)
//
// LABEL: 1 collides, 0 free, -1 unknown. MARGIN in metres: least distance if free, minus the depth if not, or nan.
#define _POSIX_C_SOURCE 200112L  // clock_gettime, posix_memalign
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

enum { DONE = 0, REFUSED = 1, USAGE = 2 };  // exit statuses

// ---------------------------------------------------------------------------------------------------------- helpers

// Prints "svcd: ..." and returns 0: `return complain(...)` is how every reader below fails.
static int complain(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fprintf(stderr, "svcd: ");
  vfprintf(stderr, format, arguments);
  fprintf(stderr, "\n");
  va_end(arguments);
  return 0;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// Memory aligned for bodies and workspaces. A tool may give up when there is none; the library never does.
static void *allocate(size_t size) {
  void *memory = NULL;
  if (posix_memalign(&memory, NSVCD_ALIGNMENT, size ? size : 1) == 0) return memory;
  complain("out of memory");
  exit(REFUSED);
}

// Makes room for one more item; `items` has `count`.
static void *room_for_one(void *items, size_t count, size_t *capacity, size_t item_size) {
  if (count < *capacity) return items;
  *capacity = *capacity ? 2 * *capacity : 64;
  items = *capacity > SIZE_MAX / item_size ? NULL : realloc(items, *capacity * item_size);
  if (items) return items;
  complain("out of memory");
  exit(REFUSED);
}

// A whole file, aligned, with a 0 behind it. NULL after a complaint.
static char *read_file(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  char *text = NULL;
  size_t capacity = 0;
  *size = 0;
  while (file && !ferror(file) && !feof(file)) {
    char *larger = (char *)allocate(capacity = capacity ? 2 * capacity : 65536);
    if (text) memcpy(larger, text, *size);
    free(text);
    text = larger;
    *size += fread(text + *size, 1, capacity - *size - 1, file);
    text[*size] = 0;
  }
  int good = file && !ferror(file);
  if (!good) complain("%s: %s", path, strerror(errno));
  if (file) fclose(file);
  if (!good) free(text);
  return good ? text : NULL;
}

// ---------------------------------------------------------------------------------------------------------- numbers

static int parse_number(const char *text, double *out) {
  char *end;
  *out = strtod(text, &end);
  return end != text && *end == 0;
}
static int parse_float(const char *text, float *out) {
  double value;
  if (!parse_number(text, &value) || !(fabs(value) <= 3e38)) return 0;  // no nan, nothing that overflows a float
  *out = (float)value;
  return 1;
}
// A whole number in [low, high].
static int parse_count(const char *text, size_t low, size_t high, size_t *out) {
  char *end;
  if (!isdigit((unsigned char)text[0])) return 0;
  errno = 0;
  unsigned long long value = strtoull(text, &end, 10);
  if (*end || errno || value < low || value > high) return 0;
  *out = (size_t)value;
  return 1;
}

// --------------------------------------------------------------------------------------------------- problem files

typedef struct mesh_entry {
  const char *name, *path;  // in the text of the file
  size_t line;
  void *memory;            // of the body
  const nsvcd_body *body;  // in the units of its file
  double encode_seconds;
} mesh_entry;

typedef struct problem {
  const char *id;
  size_t line, moving, fixed;  // the bodies: indices into meshes
  float moving_scale, fixed_scale;
  nsvcd_pose fixed_pose;
  size_t first_pose, count;  // of the motion
  int label;                 // 1, 0 or -1
  double margin;             // metres, or nan
  nsvcd_answer answer;
  double microseconds;
} problem;

typedef struct problem_file {
  const char *path;
  char *text;
  mesh_entry *meshes;
  problem *problems;
  nsvcd_pose *poses;  // of all motions, one after the other
  size_t mesh_count, problem_count, pose_count, mesh_capacity, problem_capacity, pose_capacity;
} problem_file;

#define POSE_FIELDS 7
#define PROBLEM_FIELDS 16

typedef struct reader {
  const char *path;
  char *next;   // text still to be read
  size_t line;  // of the fields, from 1
  char *fields[PROBLEM_FIELDS];
  size_t field_count;  // may exceed PROBLEM_FIELDS: then those beyond are not kept
} reader;

// Splits the next line that is not empty into fields. 0 at the end of the file.
static int next_line(reader *r) {
  while (*r->next) {
    char *line = r->next, *end = line + strcspn(line, "\n");
    r->next = *end ? end + 1 : end;
    *end = 0;
    line[strcspn(line, "#")] = 0;
    r->line++, r->field_count = 0;
    for (char *field = strtok(line, " \t\r"); field; field = strtok(NULL, " \t\r"), r->field_count++) {
      if (r->field_count < PROBLEM_FIELDS) r->fields[r->field_count] = field;
    }
    if (r->field_count) return 1;
  }
  return 0;
}

static int refuse(const reader *r, const char *reason) { return complain("%s:%zu: %s", r->path, r->line, reason); }
static int refuse_field(const reader *r, const char *reason, const char *field) {
  return complain("%s:%zu: %s: '%.60s'", r->path, r->line, reason, field);
}

static int read_pose(const reader *r, char *const *fields, nsvcd_pose *pose) {
  double q[4], length = 0;
  for (size_t k = 0; k < 3; k++)
    if (!parse_float(fields[k], &pose->position[k])) return refuse_field(r, "not a finite number", fields[k]);
  for (size_t k = 0; k < 4; k++) {
    if (!parse_float(fields[3 + k], &pose->rotation[k])) return refuse_field(r, "not a finite number", fields[3 + k]);
    q[k] = strtod(fields[3 + k], NULL);
    length += q[k] * q[k];
  }
  length = sqrt(length);
  if (fabs(length - 1) > 1e-4) return refuse(r, "the quaternion is not of unit length (to 1e-4)");
  for (size_t k = 0; k < 4; k++) pose->rotation[k] = (float)(q[k] / length);
  return 1;
}

static int find_mesh(const problem_file *file, const char *name, size_t *index) {
  for (*index = 0; *index < file->mesh_count; ++*index)
    if (strcmp(file->meshes[*index].name, name) == 0) return 1;
  return 0;
}

static int read_mesh_line(const reader *r, problem_file *file) {
  size_t found;
  if (r->field_count != 3) return refuse(r, "expected: mesh NAME PATH");
  if (find_mesh(file, r->fields[1], &found)) return refuse_field(r, "a second mesh of this name", r->fields[1]);
  file->meshes = (mesh_entry *)room_for_one(file->meshes, file->mesh_count, &file->mesh_capacity, sizeof *file->meshes);
  mesh_entry *mesh = &file->meshes[file->mesh_count++];
  memset(mesh, 0, sizeof *mesh);
  mesh->name = r->fields[1], mesh->path = r->fields[2], mesh->line = r->line;
  return 1;
}

static int read_body_fields(const reader *r, const problem_file *file, char *const *fields, size_t *mesh,
                            float *scale) {
  if (!find_mesh(file, fields[0], mesh)) return refuse_field(r, "no mesh of this name above", fields[0]);
  if (!parse_float(fields[1], scale) || *scale <= 0) return refuse_field(r, "the scale is not positive", fields[1]);
  return 1;
}

static int read_label(const reader *r, char *const *fields, problem *p) {
  if (strcmp(fields[0], "1") == 0)
    p->label = 1;
  else if (strcmp(fields[0], "0") == 0)
    p->label = 0;
  else if (strcmp(fields[0], "-1") == 0)
    p->label = -1;
  else
    return refuse_field(r, "the label is none of -1, 0, 1", fields[0]);
  if (!parse_number(fields[1], &p->margin) || isinf(p->margin))
    return refuse_field(r, "the margin is neither finite nor nan", fields[1]);
  return 1;
}

// The COUNT lines below a problem.
static int read_motion(reader *r, problem_file *file, problem *p) {
  p->first_pose = file->pose_count;
  for (size_t i = 0; i < p->count; i++) {
    if (!next_line(r) || strcmp(r->fields[0], "problem") == 0 || strcmp(r->fields[0], "mesh") == 0)
      return complain("%s:%zu: problem %s has %zu of its %zu poses", r->path, p->line, p->id, i, p->count);
    if (r->field_count != POSE_FIELDS) return refuse(r, "expected a pose: x y z qx qy qz qw");
    file->poses = (nsvcd_pose *)room_for_one(file->poses, file->pose_count, &file->pose_capacity, sizeof *file->poses);
    if (!read_pose(r, r->fields, &file->poses[file->pose_count++])) return 0;
  }
  return 1;
}

static int read_problem(reader *r, problem_file *file) {
  problem p;
  memset(&p, 0, sizeof p);
  char **fields = r->fields;
  if (r->field_count != PROBLEM_FIELDS)
    return refuse(r, "expected: problem ID MOVING SCALE FIXED SCALE x y z qx qy qz qw LABEL MARGIN COUNT");
  p.id = fields[1], p.line = r->line;
  if (!read_body_fields(r, file, fields + 2, &p.moving, &p.moving_scale)) return 0;
  if (!read_body_fields(r, file, fields + 4, &p.fixed, &p.fixed_scale)) return 0;
  if (!read_pose(r, fields + 6, &p.fixed_pose)) return 0;
  if (!read_label(r, fields + 13, &p)) return 0;
  if (!parse_count(fields[15], 1, NSVCD_MAX_POSES, &p.count))
    return refuse_field(r, "COUNT is not in 1..65536", fields[15]);
  if (!read_motion(r, file, &p)) return 0;
  file->problems =
      (problem *)room_for_one(file->problems, file->problem_count, &file->problem_capacity, sizeof *file->problems);
  file->problems[file->problem_count++] = p;
  return 1;
}

static int read_problems(const char *path, problem_file *file) {
  size_t size;
  memset(file, 0, sizeof *file);
  file->path = path;
  file->text = read_file(path, &size);
  if (!file->text) return 0;
  reader r;
  memset(&r, 0, sizeof r);
  r.path = path, r.next = file->text;
  if (strlen(file->text) != size) return complain("%s: not a text file: it has a zero byte", path);
  if (!next_line(&r) || r.field_count != 2 || strcmp(r.fields[0], "nsvcd-problems") != 0)
    return complain("%s:%zu: the first line is not 'nsvcd-problems 1'", path, r.line ? r.line : 1);
  if (strcmp(r.fields[1], "1") != 0) return refuse_field(&r, "only version 1 is known", r.fields[1]);
  while (next_line(&r)) {
    int is_mesh = strcmp(r.fields[0], "mesh") == 0, is_problem = strcmp(r.fields[0], "problem") == 0;
    if (!is_mesh && !is_problem) return refuse_field(&r, "expected 'mesh' or 'problem'", r.fields[0]);
    if (!(is_mesh ? read_mesh_line(&r, file) : read_problem(&r, file))) return 0;
  }
  return 1;
}

static void free_problems(problem_file *file) {
  for (size_t i = 0; i < file->mesh_count; i++) free(file->meshes[i].memory);
  free(file->text), free(file->meshes), free(file->problems), free(file->poses);
}

// --------------------------------------------------------------------------------------------------------- encoding

// Loads and encodes one mesh into fresh memory. `from`: what asks for it, for messages ("file:line: "), or "".
static const nsvcd_body *encode_file(const char *from, const char *path, const nsvcd_encode_options *options,
                                     void **memory, double *encode_seconds) {
  nsvcd_mesh mesh;
  size_t line = 0, points = options->points ? options->points : NSVCD_MAX_POINTS;
  nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, &line);
  if (result && line) complain("%s%s:%zu: %s", from, path, line, nsvcd_result_string(result));
  if (result && !line) complain("%s%s: %s", from, path, nsvcd_result_string(result));
  if (result) return NULL;
  const nsvcd_body *body = NULL;
  double start = seconds();
  *memory = allocate(nsvcd_body_size(points));
  result = nsvcd_encode(&mesh, options, NULL, *memory, nsvcd_body_size(points), &body);
  *encode_seconds = seconds() - start;
  nsvcd_mesh_free(&mesh, NULL);
  if (!result) return body;
  complain("%s%s: %s", from, path, nsvcd_result_string(result));
  free(*memory);
  *memory = NULL;
  return NULL;
}

// Every mesh once, in the units of its file: nsvcd_body_scale makes the rest.
static int encode_meshes(problem_file *file, const nsvcd_encode_options *options) {
  const char *slash = strrchr(file->path, '/');
  size_t folder = slash ? (size_t)(slash - file->path) + 1 : 0;
  for (size_t i = 0; i < file->mesh_count; i++) {
    mesh_entry *mesh = &file->meshes[i];
    char from[1024], path[4096];
    snprintf(from, sizeof from, "%s:%zu: mesh %s: ", file->path, mesh->line, mesh->name);
    snprintf(path, sizeof path, "%.*s%s", mesh->path[0] == '/' ? 0 : (int)folder, file->path, mesh->path);
    mesh->body = encode_file(from, path, options, &mesh->memory, &mesh->encode_seconds);
    if (!mesh->body) return 0;
  }
  return 1;
}

// ------------------------------------------------------------------------------------------------------------ check

typedef struct check_options {
  nsvcd_encode_options encode;
  nsvcd_sweep_options sweep;
  size_t repeat;
  const char *path;
} check_options;

// Memory that all queries share: two scaled bodies and the workspace.
typedef struct bench {
  void *moving, *fixed, *workspace;
  size_t body_size, workspace_size;
} bench;

// Answers one problem: once to warm up, then --repeat times by the clock. The shortest time counts: what is longer is
// the machine doing something else.
static int answer(const problem_file *file, const check_options *options, bench *b, problem *p) {
  const nsvcd_body *moving, *fixed;
  nsvcd_result result =
      nsvcd_body_scale(file->meshes[p->moving].body, p->moving_scale, b->moving, b->body_size, &moving);
  if (!result) result = nsvcd_body_scale(file->meshes[p->fixed].body, p->fixed_scale, b->fixed, b->body_size, &fixed);
  if (result) return complain("%s:%zu: scale: %s", file->path, p->line, nsvcd_result_string(result));
  p->microseconds = HUGE_VAL;
  for (size_t i = 0; i <= options->repeat; i++) {
    double start = seconds();
    result = nsvcd_sweep(moving, file->poses + p->first_pose, p->count, fixed, &p->fixed_pose, &options->sweep,
                         b->workspace, b->workspace_size, &p->answer);
    double taken = 1e6 * (seconds() - start);
    if (result) return complain("%s:%zu: problem %s: %s", file->path, p->line, p->id, nsvcd_result_string(result));
    if (i > 0) p->microseconds = fmin(p->microseconds, taken);
  }
  return 1;
}

static int answer_all(problem_file *file, const check_options *options) {
  bench b;
  b.body_size = nsvcd_body_size(options->encode.points ? options->encode.points : NSVCD_DEFAULT_POINTS);
  b.workspace_size = nsvcd_sweep_workspace_size();
  b.moving = allocate(b.body_size), b.fixed = allocate(b.body_size), b.workspace = allocate(b.workspace_size);
  int good = 1;
  for (size_t i = 0; i < file->problem_count && good; i++) good = answer(file, options, &b, &file->problems[i]);
  free(b.moving), free(b.fixed), free(b.workspace);
  return good;
}

static int print_answers(const problem_file *file) {
  for (size_t i = 0; i < file->problem_count; i++) {
    const problem *p = &file->problems[i];
    const nsvcd_answer *a = &p->answer;
    printf("%s\t%.9g\t%d\t%.9g\t%lu\t%lu\t%s\t%.2f\n", p->id, (double)a->logit, a->collides, (double)a->time,
           (unsigned long)a->moving_patch, (unsigned long)a->fixed_patch, nsvcd_status_string(a->status),
           p->microseconds);
  }
  if (fflush(stdout) == 0 && !ferror(stdout)) return 1;
  return complain("standard output: %s", strerror(errno));
}

// ---------------------------------------------------------------------------------------------------------- summary

// Wilson's interval for `hits` of `count`, 95 %, as two shares: honest also near 0 and 1, where p +- 2 s is not.
static void wilson(size_t hits, size_t count, double *low, double *high) {
  double n = (double)count, p = (double)hits / n, z = 1.959964, zz = z * z;
  double middle = (p + zz / (2 * n)) / (1 + zz / n);
  double half = z * sqrt(p * (1 - p) / n + zz / (4 * n * n)) / (1 + zz / n);
  *low = fmax(0, middle - half), *high = fmin(1, middle + half);
}
static void print_share(const char *name, size_t hits, size_t count, const char *of) {
  double low, high;
  if (!count) return;
  wilson(hits, count, &low, &high);
  fprintf(stderr, "%-20s %7.2f %%  [%.2f, %.2f]  %zu of %zu %s\n", name, 100.0 * (double)hits / (double)count,
          100 * low, 100 * high, hits, count, of);
}

#define BANDS 6
static const double band_edges[BANDS] = {0.001, 0.0025, 0.005, 0.010, 0.020, HUGE_VAL};  // metres
static const char *const band_names[BANDS + 1] = {"0 - 1", "1 - 2.5", "2.5 - 5", "5 - 10", "10 - 20", "> 20", "nan"};

static size_t band_of(double margin) {  // BANDS if unknown
  size_t band = 0;
  if (isnan(margin)) return BANDS;
  while (fabs(margin) > band_edges[band]) band++;
  return band;
}

// Counts by band (BANDS: no margin), truth and verdict.
typedef struct tally {
  size_t at[BANDS + 1][2][2];
} tally;

static size_t tally_sum(const tally *t, int label, int verdict) {
  size_t sum = 0;
  for (size_t band = 0; band <= BANDS; band++) sum += t->at[band][label][verdict];
  return sum;
}
static void print_ratio(size_t right, size_t count) {
  if (!count)
    fprintf(stderr, "  %20s", "-     ");
  else
    fprintf(stderr, "  %6.2f %6zu/%-6zu", 100.0 * (double)right / (double)count, right, count);
}
static void print_bands(const tally *t) {
  fprintf(stderr, "\n%-12s  %20s  %20s  %20s\n", "|margin| mm", "colliding: found, %", "free: cleared, %", "both, %");
  for (size_t band = 0; band <= BANDS; band++) {
    const size_t(*at)[2] = t->at[band];
    size_t collide = at[1][0] + at[1][1], clear = at[0][0] + at[0][1];
    if (collide + clear == 0) continue;
    fprintf(stderr, "%-12s", band_names[band]);
    print_ratio(at[1][1], collide);
    print_ratio(at[0][0], clear);
    print_ratio(at[1][1] + at[0][0], collide + clear);
    fprintf(stderr, "\n");
  }
}
static void print_accuracy(const problem_file *file) {
  tally t;
  memset(&t, 0, sizeof t);
  for (size_t i = 0; i < file->problem_count; i++) {
    const problem *p = &file->problems[i];
    if (p->label >= 0) t.at[band_of(p->margin)][p->label][p->answer.collides]++;
  }
  size_t missed = tally_sum(&t, 1, 0), found = tally_sum(&t, 1, 1);
  size_t cleared = tally_sum(&t, 0, 0), alarms = tally_sum(&t, 0, 1);
  if (missed + found + cleared + alarms == 0) return;
  print_share("accuracy", found + cleared, missed + found + cleared + alarms, "right");
  print_share("false negatives", missed, missed + found, "collisions missed");
  print_share("false positives", alarms, alarms + cleared, "free motions stopped");
  print_bands(&t);
}

static void print_statuses(const problem_file *file) {
  fprintf(stderr, "\nstatus:");
  for (int status = NSVCD_STATUS_OK; status <= NSVCD_STATUS_LIMIT; status++) {
    size_t count = 0;
    for (size_t i = 0; i < file->problem_count; i++) count += (int)file->problems[i].answer.status == status;
    fprintf(stderr, "%s %s %.1f %%", status ? "," : "", nsvcd_status_string((nsvcd_status)status),
            100.0 * (double)count / (double)file->problem_count);
  }
  fprintf(stderr, "\n");
}

static int compare_doubles(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}
// Sorts, and prints median, mean, 99th percentile and worst.
static void print_distribution(const char *name, double *values, size_t count, const char *unit) {
  double sum = 0;
  if (!count) return;
  qsort(values, count, sizeof *values, compare_doubles);
  for (size_t i = 0; i < count; i++) sum += values[i];
  fprintf(stderr, "%s: median %.1f, mean %.1f, 99th percentile %.1f, worst %.1f %s\n", name,
          (values[(count - 1) / 2] + values[count / 2]) / 2, sum / (double)count,
          values[(size_t)ceil(0.99 * (double)count) - 1], values[count - 1], unit);
}
static void print_costs(const problem_file *file) {
  size_t most = file->problem_count > file->mesh_count ? file->problem_count : file->mesh_count;
  double *values = (double *)allocate(most * sizeof(double)), bytes = 0, points = 0;
  for (size_t i = 0; i < file->problem_count; i++) values[i] = file->problems[i].microseconds;
  print_distribution("a query", values, file->problem_count, "us");
  for (size_t i = 0; i < file->mesh_count; i++) {
    nsvcd_body_facts facts = nsvcd_body_describe(file->meshes[i].body);
    bytes += (double)facts.size / (double)file->mesh_count, points += (double)facts.points / (double)file->mesh_count;
    values[i] = 1e3 * file->meshes[i].encode_seconds;
  }
  print_distribution("encoding a mesh", values, file->mesh_count, "ms");
  if (file->mesh_count) fprintf(stderr, "a body: %.0f bytes, %.1f points (mean)\n", bytes, points);
  free(values);
}

static void print_summary(const problem_file *file) {
  size_t labels[3] = {0, 0, 0};  // -1, 0, 1
  for (size_t i = 0; i < file->problem_count; i++) labels[file->problems[i].label + 1]++;
  fprintf(stderr, "%s: %zu problems (%zu collide, %zu free, %zu without a label), %zu meshes\n", file->path,
          file->problem_count, labels[2], labels[1], labels[0], file->mesh_count);
  if (!file->problem_count) return;
  print_accuracy(file);
  print_statuses(file);
  print_costs(file);
}

// --------------------------------------------------------------------------------------------------- command line

static int usage(void) {
  fprintf(stderr,
          "svcd check [--points N] [--pairs K] [--model tiny|small|base] [--int8] [--recall R]\n"
          "           [--verify BAND|all] [--repeat R] FILE\n"
          "    answers the problems of FILE, a line each on standard output, separated by tabs:\n"
          "    ID LOGIT COLLIDES TIME MOVING_PATCH FIXED_PATCH STATUS MICROSECONDS; a summary on standard error.\n"
          "      --points N   representative points per body, 1..%d (%d)\n"
          "      --pairs K    pairs of patches that the network looks at, 1..%d (8)\n"
          "      --model M    decoder (base)\n"
          "      --recall R   share of collisions to be found: 0.99, 0.999, 0.9999 or 0: balanced errors (0)\n"
          "      --repeat R   time every query R times, report the least (5)\n"
          "      --int8       the decoder in 8-bit integers\n"
          "      --verify     exact verification: not there yet\n"
          "svcd encode IN.obj OUT.body|OUT.h [--points N | --radius METRES]\n"
          "    encodes a mesh, to a file or to a C array; --radius: as many points as make patches of that radius\n"
          "svcd info FILE.body\n"
          "exit status: 0 done, 1 a file or line was refused, 2 usage\n",
          NSVCD_MAX_POINTS, NSVCD_DEFAULT_POINTS, NSVCD_MAX_PAIRS);
  return USAGE;
}
static int usage_error(const char *option, const char *reason) {
  complain("%s: %s", option, reason);
  return USAGE;
}

static int parse_model(const char *name, nsvcd_model *model) {
  static const char *const names[] = {"tiny", "small", "base"};
  for (int i = 0; i < 3; i++) {
    if (strcmp(name, names[i]) != 0) continue;
    *model = (nsvcd_model)(NSVCD_MODEL_TINY + i);
    return 1;
  }
  return 0;
}

// Returns DONE or USAGE.
static int parse_check_option(const char *key, const char *value, check_options *options) {
  if (strcmp(key, "--points") == 0)
    return parse_count(value, 1, NSVCD_MAX_POINTS, &options->encode.points) ? DONE : usage_error(key, "out of range");
  if (strcmp(key, "--pairs") == 0)
    return parse_count(value, 1, NSVCD_MAX_PAIRS, &options->sweep.pairs) ? DONE : usage_error(key, "out of range");
  if (strcmp(key, "--repeat") == 0)
    return parse_count(value, 1, 1000000, &options->repeat) ? DONE : usage_error(key, "out of range");
  if (strcmp(key, "--model") == 0)
    return parse_model(value, &options->sweep.model) ? DONE : usage_error(key, "none of tiny, small, base");
  if (strcmp(key, "--recall") == 0)
    return parse_float(value, &options->sweep.recall) ? DONE : usage_error(key, "not a number");
  if (strcmp(key, "--verify") == 0) return usage_error(key, "exact verification is not in the library yet");
  return usage_error(key, "no such option");
}

// The library knows which recalls it was calibrated for: ask it before any work is done. A body of one triangle serves.
static int recall_is_known(const nsvcd_sweep_options *options) {
  float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  uint32_t indices[3] = {0, 1, 2};
  nsvcd_mesh mesh = {positions, indices, 3, 1};
  nsvcd_encode_options one_point = {1, 0};
  nsvcd_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd_answer unused;
  const nsvcd_body *body;
  void *memory = allocate(nsvcd_body_size(1)), *workspace = allocate(nsvcd_sweep_workspace_size());
  nsvcd_result result = nsvcd_encode(&mesh, &one_point, NULL, memory, nsvcd_body_size(1), &body);
  if (!result)
    result = nsvcd_sweep(body, &pose, 1, body, &pose, options, workspace, nsvcd_sweep_workspace_size(), &unused);
  free(memory), free(workspace);
  return result == NSVCD_OK;
}

static int parse_check(int argc, char **argv, check_options *options) {
  memset(options, 0, sizeof *options);
  options->repeat = 5;
  for (int i = 0; i < argc; i++) {
    int status = DONE;
    if (strcmp(argv[i], "--int8") == 0) {
      options->sweep.precision = NSVCD_PRECISION_INT8;
      continue;
    }
    if (argv[i][0] != '-' && options->path) return usage_error(argv[i], "one problem file at a time");
    if (argv[i][0] != '-')
      options->path = argv[i];
    else if (i + 1 == argc)
      status = usage_error(argv[i], "a value is missing, or there is no such option");
    else
      status = parse_check_option(argv[i], argv[i + 1], options), i++;
    if (status != DONE) return status;
  }
  if (!options->path) return usage();
  if (!recall_is_known(&options->sweep)) return usage_error("--recall", "none of 0, 0.99, 0.999, 0.9999");
  return DONE;
}

static int check(int argc, char **argv) {
  check_options options;
  int status = parse_check(argc, argv, &options);
  if (status != DONE) return status;
  problem_file file;
  int good = read_problems(options.path, &file) && encode_meshes(&file, &options.encode) &&
             answer_all(&file, &options) && print_answers(&file);
  if (good) print_summary(&file);
  free_problems(&file);
  return good ? DONE : REFUSED;
}

// --------------------------------------------------------------------------------------------------- encode and info

static int ends_with(const char *text, const char *end) {
  size_t n = strlen(text), m = strlen(end);
  return n >= m && strcmp(text + n - m, end) == 0;
}

// "parts/my-mug.h" -> "my_mug_body".
static void array_name(const char *path, char *name, size_t size) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  int digit = isdigit((unsigned char)base[0]);  // no C name begins with one
  snprintf(name, size, "%s%.*s_body", digit ? "_" : "", (int)(strlen(base) < 40 ? strlen(base) - 2 : 40), base);
  for (char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c)) *c = '_';
}

static void write_header(FILE *file, const char *in, const char *name, const nsvcd_body *body) {
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  const unsigned char *bytes = (const unsigned char *)body;
  fprintf(file,
          "// %s, encoded for neuralsvcd.h by `svcd encode`: %zu points. Little-endian hosts only.\n"
          "//   const nsvcd_body *body;\n"
          "//   nsvcd_result result = nsvcd_body_load(%s, sizeof %s, &body);\n"
          "#if defined(__cplusplus)\n"
          "alignas(%d)\n"
          "#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L\n"
          "_Alignas(%d)\n"
          "#elif defined(__GNUC__)\n"
          "__attribute__((aligned(%d)))\n"
          "#elif defined(_MSC_VER)\n"
          "__declspec(align(%d))\n"
          "#endif\n"
          "static const unsigned char %s[%zu] = {",
          in, facts.points, name, name, NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, name,
          facts.size);
  for (size_t i = 0; i < facts.size; i++) fprintf(file, "%s%d,", i % 24 ? "" : "\n    ", bytes[i]);
  fprintf(file, "\n};\n");
}

static int write_body(const char *in, const char *out, const nsvcd_body *body) {
  int header = ends_with(out, ".h"), good;
  FILE *file = fopen(out, header ? "w" : "wb");
  if (!file) return complain("%s: %s", out, strerror(errno));
  if (header) {
    char name[64];
    array_name(out, name, sizeof name);
    write_header(file, in, name, body);
  } else {
    fwrite(body, 1, nsvcd_body_describe(body).size, file);
  }
  good = !ferror(file);
  if (fclose(file) != 0 || !good) return complain("%s: cannot be written", out);
  return 1;
}

static void print_facts(const char *path, const nsvcd_body *body) {
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  float centre[3], radius, least = facts.radius, most = 0;
  for (uint32_t i = 0; nsvcd_body_patch(body, i, centre, &radius); i++)
    least = fminf(least, radius), most = fmaxf(most, radius);
  printf("%s: %zu points, %zu bytes\n", path, facts.points, facts.size);
  printf("bounding sphere: centre %g %g %g, radius %g m\n", (double)facts.centre[0], (double)facts.centre[1],
         (double)facts.centre[2], (double)facts.radius);
  printf("patch radius: mean %g, least %g, most %g m\n", (double)facts.mean_patch_radius, (double)least, (double)most);
}

static int encode(int argc, char **argv) {
  const char *paths[2] = {NULL, NULL};
  nsvcd_encode_options options = {0, 0};
  int path_count = 0;
  for (int i = 0; i < argc; i++) {
    const char *value = i + 1 < argc ? argv[i + 1] : "";
    if (argv[i][0] != '-') {
      if (path_count == 2) return usage();
      paths[path_count++] = argv[i];
    } else if (strcmp(argv[i], "--points") == 0) {
      if (!parse_count(value, 1, NSVCD_MAX_POINTS, &options.points)) return usage_error(argv[i], "out of range");
      i++;
    } else if (strcmp(argv[i], "--radius") == 0) {
      if (!parse_float(value, &options.patch_radius) || options.patch_radius <= 0)
        return usage_error(argv[i], "not a positive number of metres");
      i++;
    } else {
      return usage_error(argv[i], "no such option");
    }
  }
  if (path_count != 2) return usage();
  if (!ends_with(paths[1], ".body") && !ends_with(paths[1], ".h")) return usage_error(paths[1], "neither .body nor .h");
  if (options.points && options.patch_radius > 0) return usage_error("--radius", "not together with --points");

  void *memory = NULL;
  double taken;
  const nsvcd_body *body = encode_file("", paths[0], &options, &memory, &taken);
  int good = body && write_body(paths[0], paths[1], body);
  if (good) print_facts(paths[1], body);
  if (good) printf("encoded in %.1f ms\n", 1e3 * taken);
  free(memory);
  return good ? DONE : REFUSED;
}

static int info(int argc, char **argv) {
  if (argc != 1) return usage();
  size_t size;
  char *memory = read_file(argv[0], &size);
  if (!memory) return REFUSED;
  const nsvcd_body *body;
  nsvcd_result result = nsvcd_body_load(memory, size, &body);
  if (result) complain("%s: %s", argv[0], nsvcd_result_string(result));
  if (!result) print_facts(argv[0], body);
  free(memory);
  return result ? REFUSED : DONE;
}

int main(int argc, char **argv) {
  if (argc > 1 && strcmp(argv[1], "check") == 0) return check(argc - 2, argv + 2);
  if (argc > 1 && strcmp(argv[1], "encode") == 0) return encode(argc - 2, argv + 2);
  if (argc > 1 && strcmp(argv[1], "info") == 0) return info(argc - 2, argv + 2);
  return usage();
}
