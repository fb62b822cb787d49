// problem_file.h - reads problem files (version 1), with messages that name file, line and reason;
// what svcd.c and the benchmark share: memory, clock, numbers, intervals. No part of the library.
// Include neuralsvcd.h first, and define _POSIX_C_SOURCE 200112L before anything (clock.h) and
// PROGRAM, the name that messages begin with.
//
//   nsvcd-problems 1
//   mesh NAME PATH                        # OBJ, relative to the problem file
//   problem ID MOVING SCALE FIXED SCALE  x y z qx qy qz qw  LABEL MARGIN COUNT [FIXED_COUNT]
//   x y z qx qy qz qw                     # COUNT lines: pose of the moving body at t = i/(COUNT-1)
//   x y z qx qy qz qw                     # FIXED_COUNT lines: the same of the other body, which
//                                         then moves too; the pose on the problem line, else its
//                                         pose, does not count
//
// LABEL: 1 collides, 0 free, -1 unknown. MARGIN in metres: least distance if free, minus the depth
// if not, or nan.
#ifndef NSVCD_SCENERY_PROBLEM_FILE_H
#define NSVCD_SCENERY_PROBLEM_FILE_H

#include <ctype.h>
#include <math.h>

#include "files.h"

enum { DONE = 0, REFUSED = 1, USAGE = 2 };  // exit statuses

// ----------------------------------------------------------------------------------------- helpers

// Makes room for one more item; `items` has `count`.
static void *room_for_one(void *items, size_t count, size_t *capacity, size_t item_size) {
  if (count < *capacity) return items;
  *capacity = *capacity ? 2 * *capacity : 64;
  items = *capacity > SIZE_MAX / item_size ? NULL : realloc(items, *capacity * item_size);
  if (!items) give_up();
  return items;
}

// ----------------------------------------------------------------------------------------- numbers

static int parse_number(const char *text, double *out) {
  char *end;
  *out = strtod(text, &end);
  return end != text && *end == 0;
}
static int parse_float(const char *text, float *out) {
  double value;
  // no nan, nothing that overflows a float
  if (!parse_number(text, &value) || !(fabs(value) <= 3e38)) return 0;
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

// ----------------------------------------------------------------------------------- problem files

typedef struct mesh_entry {
  const char *name, *path;  // parts of the file's text
  size_t line;
} mesh_entry;

typedef struct problem {
  const char *id;
  size_t line, moving, fixed;  // the bodies: indices into meshes
  float moving_scale, fixed_scale;
  nsvcd_pose fixed_pose;
  size_t first_pose, count;  // the moving body's poses
  size_t fixed_count;        // poses of the other body, behind those; 0: it rests at fixed_pose
  int label;                 // 1, 0 or -1
  double margin;             // metres, or nan
} problem;

typedef struct problem_file {
  const char *path;
  char *text;
  mesh_entry *meshes;
  problem *problems;
  nsvcd_pose *poses;  // all motions' poses, one after the other
  size_t mesh_count, problem_count, pose_count, mesh_capacity, problem_capacity, pose_capacity;
} problem_file;

#define POSE_FIELDS 7
#define PROBLEM_FIELDS 16
#define MOST_FIELDS 300  // a line's; a plan has two for each joint, and a few more

typedef struct reader {
  const char *path;
  char *next;   // text still to be read
  size_t line;  // number of the line that the fields are of, from 1
  char *fields[MOST_FIELDS];
  size_t field_count;  // may exceed MOST_FIELDS: then those beyond are not kept
  char *note;          // what stands behind a #, or ""
} reader;

// Splits the next line that is not empty into fields. 0 at the end of the file.
static int next_line(reader *r) {
  while (*r->next) {
    char *line = r->next;
    char *end = line + strcspn(line, "\n");
    r->next = *end ? end + 1 : end;
    *end = 0;
    r->note = line + strcspn(line, "#");
    if (*r->note) *r->note++ = 0;
    r->line++;
    r->field_count = 0;
    for (char *field = strtok(line, " \t\r"); field;
         field = strtok(NULL, " \t\r"), r->field_count++) {
      if (r->field_count < MOST_FIELDS) r->fields[r->field_count] = field;
    }
    if (r->field_count) return 1;
  }
  return 0;
}

static int refuse(const reader *r, const char *reason) {
  return complain("%s:%zu: %s", r->path, r->line, reason);
}
static int refuse_field(const reader *r, const char *reason, const char *field) {
  return complain("%s:%zu: %s: '%.60s'", r->path, r->line, reason, field);
}

static int read_pose(const reader *r, char *const *fields, nsvcd_pose *pose) {
  double q[4];
  double length = 0;
  for (size_t k = 0; k < 3; k++)
    if (!parse_float(fields[k], &pose->position[k]))
      return refuse_field(r, "not a finite number", fields[k]);
  for (size_t k = 0; k < 4; k++) {
    if (!parse_float(fields[3 + k], &pose->rotation[k]))
      return refuse_field(r, "not a finite number", fields[3 + k]);
    q[k] = strtod(fields[3 + k], NULL);
    length += q[k] * q[k];
  }
  length = sqrt(length);
  if (fabs(length - 1) > (double)NSVCD_UNIT_TOLERANCE)
    return refuse(r, "the quaternion is not of unit length (to 1e-4)");
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
  if (find_mesh(file, r->fields[1], &found))
    return refuse_field(r, "a second mesh of this name", r->fields[1]);
  file->meshes = (mesh_entry *)room_for_one(file->meshes, file->mesh_count, &file->mesh_capacity,
                                            sizeof *file->meshes);
  mesh_entry *mesh = &file->meshes[file->mesh_count++];
  memset(mesh, 0, sizeof *mesh);
  mesh->name = r->fields[1];
  mesh->path = r->fields[2];
  mesh->line = r->line;
  return 1;
}

static int read_body_fields(const reader *r, const problem_file *file, char *const *fields,
                            size_t *mesh, float *scale) {
  if (!find_mesh(file, fields[0], mesh))
    return refuse_field(r, "no mesh of this name above", fields[0]);
  if (!parse_float(fields[1], scale) || *scale <= 0)
    return refuse_field(r, "the scale is not positive", fields[1]);
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

// The COUNT lines below a problem, and the FIXED_COUNT ones below these.
static int read_motions(reader *r, problem_file *file, problem *p) {
  const size_t count = p->count + p->fixed_count;
  p->first_pose = file->pose_count;
  for (size_t i = 0; i < count; i++) {
    if (!next_line(r) || strcmp(r->fields[0], "problem") == 0 || strcmp(r->fields[0], "mesh") == 0)
      return complain("%s:%zu: problem %s has %zu of its %zu poses", r->path, p->line, p->id, i,
                      count);
    if (r->field_count != POSE_FIELDS) return refuse(r, "expected a pose: x y z qx qy qz qw");
    file->poses = (nsvcd_pose *)room_for_one(file->poses, file->pose_count, &file->pose_capacity,
                                             sizeof *file->poses);
    if (!read_pose(r, r->fields, &file->poses[file->pose_count++])) return 0;
  }
  return 1;
}

static int read_problem(reader *r, problem_file *file) {
  problem p;
  memset(&p, 0, sizeof p);
  char **fields = r->fields;
  if (r->field_count != PROBLEM_FIELDS && r->field_count != PROBLEM_FIELDS + 1) {
    return refuse(r,
                  "expected: problem ID MOVING SCALE FIXED SCALE x y z qx qy qz qw LABEL MARGIN "
                  "COUNT [FIXED_COUNT]");
  }
  p.id = fields[1];
  p.line = r->line;
  if (!read_body_fields(r, file, fields + 2, &p.moving, &p.moving_scale)) return 0;
  if (!read_body_fields(r, file, fields + 4, &p.fixed, &p.fixed_scale)) return 0;
  if (!read_pose(r, fields + 6, &p.fixed_pose)) return 0;
  if (!read_label(r, fields + 13, &p)) return 0;
  if (!parse_count(fields[15], 1, NSVCD_MAX_POSES, &p.count))
    return refuse_field(r, "COUNT is not in 1..65536", fields[15]);
  if (r->field_count == PROBLEM_FIELDS + 1 &&
      !parse_count(fields[16], 1, NSVCD_MAX_POSES, &p.fixed_count)) {
    return refuse_field(r, "FIXED_COUNT is not in 1..65536", fields[16]);
  }
  if (!read_motions(r, file, &p)) return 0;
  file->problems = (problem *)room_for_one(file->problems, file->problem_count,
                                           &file->problem_capacity, sizeof *file->problems);
  file->problems[file->problem_count++] = p;
  return 1;
}

// A name that a file has is printed, and so it holds nothing that a terminal obeys.
static int look_at_text(const char *from, const char *path, const char *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) {
    const unsigned char c = (unsigned char)bytes[i];
    if ((c < 32 && (c < '\t' || c > '\r')) || c == 127)
      return complain("%s%s: not a text file: it has a %s", from, path,
                      c ? "control character" : "zero byte");
  }
  return 1;
}

// Begins to read a text file whose first line is `format` and version 1. *text: to be freed. Returns
// 0 after a complaint.
static int open_reader(const char *path, const char *format, char **text, reader *r) {
  size_t size;
  memset(r, 0, sizeof *r);
  r->path = shown_name(path);
  r->next = *text = read_file("", path, &size, look_at_text);
  if (!*text || !look_at_text("", r->path, *text, size)) return 0;
  if (!next_line(r) || r->field_count != 2 || strcmp(r->fields[0], format) != 0)
    return complain("%s:%zu: the first line is not '%s 1'", r->path, r->line ? r->line : 1, format);
  return strcmp(r->fields[1], "1") == 0 || refuse_field(r, "only version 1 is known", r->fields[1]);
}

static int read_problems(const char *path, problem_file *file) {
  reader r;
  memset(file, 0, sizeof *file);
  file->path = shown_name(path);
  if (!open_reader(path, "nsvcd-problems", &file->text, &r)) return 0;
  while (next_line(&r)) {
    int is_mesh = strcmp(r.fields[0], "mesh") == 0;
    int is_problem = strcmp(r.fields[0], "problem") == 0;
    if (!is_mesh && !is_problem)
      return refuse_field(&r, "expected 'mesh' or 'problem'", r.fields[0]);
    if (!(is_mesh ? read_mesh_line(&r, file) : read_problem(&r, file))) return 0;
  }
  return 1;
}

static void free_problems(problem_file *file) {
  free(file->text);
  free(file->meshes);
  free(file->problems);
  free(file->poses);
}

// The problem as a question, but for the bodies: the moving one is a.
static nsvcd_question question_of_problem(const problem_file *file, const problem *p) {
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  question.a.poses = file->poses + p->first_pose;
  question.a.count = p->count;
  question.a.scale = p->moving_scale;
  question.b.poses = p->fixed_count ? question.a.poses + p->count : &p->fixed_pose;
  question.b.count = p->fixed_count ? p->fixed_count : 1;
  question.b.scale = p->fixed_scale;
  return question;
}

// -------------------------------------------------------------------------------------- statistics

// Wilson's interval for `hits` of `count`, 95 %, as two shares: honest also near 0 and 1, where p
// +- 2 s is not.
static void wilson(size_t hits, size_t count, double *low, double *high) {
  double n = (double)count;
  double p = (double)hits / n;
  double z = 1.959964;
  double zz = z * z;
  double middle = (p + zz / (2 * n)) / (1 + zz / n);
  double half = z * sqrt(p * (1 - p) / n + zz / (4 * n * n)) / (1 + zz / n);
  *low = fmax(0, middle - half), *high = fmin(1, middle + half);
}
#endif  // NSVCD_SCENERY_PROBLEM_FILE_H
