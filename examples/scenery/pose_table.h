// pose_table.h - how A moves, read from a table: a line for each pose, its numbers between commas,
// semicolons, tabs or blanks. Include sweep_motion.h first.
//
//   x y z                    metres, the rotation stays
//   x y z qx qy qz qw        and a unit quaternion
//   t x y z [qx qy qz qw]    when: rising, in any unit
//
// All lines have as many numbers as the first. What stands behind a # is kept as a note. A first line
// that begins with no number is skipped: the names of the columns.
#ifndef NSVCD_SCENERY_POSE_TABLE_H
#define NSVCD_SCENERY_POSE_TABLE_H

// A note without the blanks around it, and with nothing that a terminal would obey.
static char *note_of(char *note) {
  note += strspn(note, " \t");
  size_t n = strcspn(note, "\r");
  while (n > 0 && (note[n - 1] == ' ' || note[n - 1] == '\t')) n--;
  note[n] = 0;
  for (char *c = note; *c; c++) *c = isprint((unsigned char)*c) ? *c : '?';
  return note;
}

// Takes the fields of a line for pose number m->count. Returns 0 after a complaint.
static int take_pose_line(const reader *r, const double *shift, motion *m) {
  double n[8];
  const size_t timed = r->field_count == 4 || r->field_count == 8;
  const double *at = n + timed;
  oracle_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
  for (size_t i = 0; i < r->field_count; i++) parse_number(r->fields[i], &n[i]);
  for (size_t k = 0; k < 3; k++) {
    pose.position[k] = at[k] + shift[k];
    if (!(fabs(pose.position[k]) <= (double)NSVCD_MAX_COORDINATE))
      return refuse_field(r, "a coordinate is out of range", r->fields[timed + k]);
  }
  if (r->field_count > 4 &&
      !(fabs(take_quaternion(at + 3, &pose) - 1) <= (double)NSVCD_UNIT_TOLERANCE))
    return refuse(r, "the quaternion is not of unit length (to 1e-4)");
  if (timed && m->count > 0 && !(n[0] > m->times[m->count - 1]))
    return refuse_field(r, "times do not rise", r->fields[0]);
  m->poses[m->count] = pose;
  m->lines[m->count] = r->line;
  m->notes[m->count] = note_of(r->note);
  m->times[m->count] = timed ? n[0] : 0;
  m->count++;
  return 1;
}

// Refuses a line that has a field which is no number, or other than `columns` of them. 0: it does.
static int check_columns(const reader *r, size_t columns) {
  const size_t n = r->field_count;
  double number;
  for (size_t i = 0; i < n && i < MOST_FIELDS; i++)
    if (!parse_number(r->fields[i], &number) || !(fabs(number) <= 1e30))
      return refuse_field(r, "not a finite number", r->fields[i]);
  if (n != 3 && n != 4 && n != 7 && n != 8)
    return complain("%s:%zu: expected [t] x y z [qx qy qz qw], not %zu numbers", r->path, r->line,
                    n);
  if (n == columns) return 1;
  return complain("%s:%zu: expected %zu numbers, as in the lines before, not %zu", r->path, r->line,
                  columns, n);
}

static int read_pose_lines(reader *r, const double *shift, motion *m) {
  size_t columns = 0;
  int is_named = 0;
  double number;
  while (next_line(r)) {
    const size_t n = r->field_count;
    const int is_name = columns == 0 && !is_named && !parse_number(r->fields[0], &number);
    is_named |= is_name;
    if (is_name) continue;
    if (columns == 0) columns = n;
    if (!check_columns(r, columns)) return 0;
    if (m->count == NSVCD_MAX_POSES) return refuse(r, "more than 65536 poses");
    if (!take_pose_line(r, shift, m)) return 0;
  }
  m->is_timed = columns == 4 || columns == 8;
  return m->count > 0 ? 1 : complain("%s: no poses", r->path);
}

// Reads the table. shift: added to positions. Returns 0 after a complaint.
static int read_pose_table(const char *path, const double *shift, motion *m) {
  size_t size;
  reader r;
  char *text = read_file("", path, &size, look_at_text);
  if (!text) return 0;
  memset(&r, 0, sizeof r);
  r.path = shown_name(path);
  r.next = text;
  m->text = text;
  for (char *c = text; *c; c++) {
    if (*c == '#') c += strcspn(c, "\n");
    *c = *c == ',' || *c == ';' ? ' ' : *c;
    if (!*c) break;
  }
  m->lines = (size_t *)allocate(NSVCD_MAX_POSES * sizeof *m->lines);
  m->notes = (char **)allocate(NSVCD_MAX_POSES * sizeof *m->notes);
  m->times = (double *)allocate(NSVCD_MAX_POSES * sizeof *m->times);
  return look_at_text("", r.path, text, size) && read_pose_lines(&r, shift, m);
}

#endif
