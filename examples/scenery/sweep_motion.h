// sweep_motion.h - how A moves, as it is told on a command line: from a pose to a pose, turning on
// its way; or, if nothing is told, straight through B. Include load.h first.
#ifndef NSVCD_SCENERY_SWEEP_MOTION_H
#define NSVCD_SCENERY_SWEEP_MOTION_H

#include "oracle.h"
#include "shapes.h"

#define TURN_STEP 90.0     // degrees between two poses: slerp takes the shorter arc
#define TURN_MOST 36000.0  // degrees

static const char axes[] = "xyz";

typedef struct motion {
  oracle_pose *poses;  // (count), room for NSVCD_MAX_POSES
  size_t count;
  double *times;  // (count) of a table that has times, as it says them
  size_t *lines;  // (count) of the table
  char **notes;   // (count) what stands behind a # there, or ""
  char *text;     // of which these are
  int is_timed;   // the table has times
  int through;    // the axis along which A passes through B; -1: as it was told
  int turn;       // the axis about which it turns
  double degrees;
} motion;

// The numbers of a list, separated by commas or blanks; 0 if it is none, or if there are more. most_of:
// none is larger.
static size_t take_numbers(const char *text, double *out, size_t most, double most_of) {
  size_t count = 0;
  while (*text) {
    char *end;
    const double x = strtod(text, &end);
    if (end == text || count == most || !(fabs(x) <= most_of)) return 0;
    out[count++] = x;
    text = end + strspn(end, " ");
    if (*text == ',' && text[1])
      text++;
    else if (*text && end == text)
      return 0;
  }
  return count;
}

// Takes x y z w as the pose's rotation. Returns its length, which a caller refuses if it is not 1 to
// NSVCD_UNIT_TOLERANCE.
static double take_quaternion(const double *q, oracle_pose *pose) {
  memcpy(pose->rotation, q, sizeof pose->rotation);
  oracle_quat_normalize(pose->rotation);
  return sqrt(oracle_dot(q, q) + q[3] * q[3]);
}

// "x,y,z" leaves the rotation as it is; "x,y,z,qx,qy,qz,qw" not. shift: added to the position, which
// then must be within bounds. Returns 0 after a complaint.
static int take_pose(const char *name, const char *text, const double *shift, oracle_pose *pose) {
  double n[7];
  size_t count = take_numbers(text, n, 7, 1e30);
  for (size_t k = 0; k < 3 && k < count; k++) {
    n[k] += shift[k];
    if (!(fabs(n[k]) <= (double)NSVCD_MAX_COORDINATE)) count = 0;
  }
  if (count != 3 && count != 7)
    return complain("%s %s: not x,y,z nor x,y,z,qx,qy,qz,qw, each up to %g (NSVCD_MAX_COORDINATE)",
                    name, text, (double)NSVCD_MAX_COORDINATE);
  memcpy(pose->position, n, sizeof pose->position);
  if (count == 3) return 1;
  const double length = take_quaternion(n + 3, pose);
  if (!(fabs(length - 1) <= (double)NSVCD_UNIT_TOLERANCE))
    return complain("%s %s: the quaternion qx,qy,qz,qw has the length %.6g, not 1 to %g", name,
                    text, length, (double)NSVCD_UNIT_TOLERANCE);
  return 1;
}

// "z,90". Returns 0 after a complaint.
static int take_turn(const char *text, motion *m) {
  const char *letter = text[0] ? strchr(axes, text[0]) : NULL;
  if (!letter || text[1] != ',' || !parse_number(text + 2, &m->degrees) ||
      !(fabs(m->degrees) <= TURN_MOST))
    return complain("--rotate %s: not AXIS,DEGREES, as in z,90; up to %g degrees", text, TURN_MOST);
  m->turn = (int)(letter - axes);
  return 1;
}

// A passes through the middle of B's box, from outside to outside, downwards along the axis along
// which B is thinnest. Returns the axis.
static int pass_through(const thing *a, const thing *b, oracle_pose *from, oracle_pose *to) {
  int axis = 0;
  double longest = 0;
  for (int k = 0; k < 3; k++) {
    if (b->high[k] - b->low[k] < b->high[axis] - b->low[axis]) axis = k;
    longest = fmax(longest, fmax(a->high[k] - a->low[k], b->high[k] - b->low[k]));
    from->position[k] = (b->low[k] + b->high[k] - a->low[k] - a->high[k]) / 2;
    to->position[k] = from->position[k];
  }
  const double thick = a->high[axis] - a->low[axis];
  const double away = (b->high[axis] - b->low[axis]) / 2 + thick + longest / 10;
  from->position[axis] += away;
  to->position[axis] -= away;
  return axis;
}

typedef struct motion_told {
  const char *from, *to, *rotate, *poses;  // NULL: not
  double shift[3];                         // metres, to what is told of A's place
} motion_told;

static int read_pose_table(const char *path, const double *shift, motion *m);

// Makes the motion that was told. Returns 0 after a complaint.
static int take_motion(const motion_told *told, const thing *a, const thing *b, motion *m) {
  oracle_pose from = {{told->shift[0], told->shift[1], told->shift[2]}, {0, 0, 0, 1}};
  oracle_pose to = from;
  m->degrees = 0;
  m->through = -1;
  if (told->poses) return read_pose_table(told->poses, told->shift, m);
  if (!told->from && !told->to) m->through = pass_through(a, b, &from, &to);
  if (told->from && !take_pose("--from", told->from, told->shift, &from)) return 0;
  if (told->to) memcpy(to.rotation, from.rotation, sizeof to.rotation);
  if (told->to && !take_pose("--to", told->to, told->shift, &to)) return 0;
  m->count = 2;
  m->poses[0] = from;
  m->poses[1] = to;
  if (!told->rotate) return 1;
  if (!take_turn(told->rotate, m)) return 0;
  if (memcmp(from.rotation, to.rotation, sizeof to.rotation) != 0)
    return complain("--rotate: not together with another rotation in --to");
  const size_t steps = (size_t)fmax(1, ceil(fabs(m->degrees) / TURN_STEP));
  const double axis[3] = {m->turn == 0, m->turn == 1, m->turn == 2};
  for (size_t i = 0; i <= steps; i++) {
    const double f = (double)i / (double)steps;
    double turn[4];
    m->poses[i] = oracle_pose_between(&from, &to, f);
    oracle_axis_angle(axis, f * m->degrees * SHAPES_PI / 180, turn);
    oracle_quat_mul(turn, from.rotation, m->poses[i].rotation);
  }
  m->count = steps + 1;
  return 1;
}

// The share of the motion at which pose i is, and where in the table a share is: after pose i.
static double share_of_pose(const motion *m, size_t i) {
  const size_t last = m->count - 1;
  if (last == 0) return 0;
  if (!m->is_timed) return (double)i / (double)last;
  return (m->times[i] - m->times[0]) / (m->times[last] - m->times[0]);
}
static size_t pose_before(const motion *m, double share) {
  size_t low = 0;
  size_t high = m->count - 1;
  while (low + 1 < high) {
    const size_t middle = (low + high) / 2;
    if (share_of_pose(m, middle) > share)
      high = middle;
    else
      low = middle;
  }
  return low;
}

// The share if all poses were as long apart.
static double uniform_share(const motion *m, double share) {
  const size_t i = pose_before(m, share);
  if (!m->is_timed || m->count < 2) return share;
  const double begins = share_of_pose(m, i);
  const double lasts = share_of_pose(m, i + 1) - begins;
  return ((double)i + (share - begins) / lasts) / (double)(m->count - 1);
}

// "t = 0.4"; of a table "t = 0.4 (after line 12)", in its own times if it has them: that line which
// the share `begins` is after.
static void shown_time(const motion *m, double share, double begins, char *out, size_t size) {
  const double first = m->is_timed ? m->times[0] : 0;
  const double all = m->is_timed ? m->times[m->count - 1] - first : 1;
  const int n = m->is_timed ? snprintf(out, size, "t = %.6g", first + share * all)
                            : snprintf(out, size, m->lines ? "t = %.6f" : "t = %.4f", share);
  if (m->lines && n > 0 && (size_t)n < size)
    snprintf(out + n, size - (size_t)n, " (after line %zu)", m->lines[pose_before(m, begins)]);
}

static void print_motion(const motion *m) {
  const oracle_pose *from = &m->poses[0];
  const oracle_pose *to = &m->poses[m->count - 1];
  double axis[3];
  const double arc = oracle_quat_arc(from->rotation, to->rotation, axis) * 180 / SHAPES_PI;
  printf("motion     A from %.6g %.6g %.6g to %.6g %.6g %.6g", from->position[0], from->position[1],
         from->position[2], to->position[0], to->position[1], to->position[2]);
  if (m->degrees != 0)
    printf(", turning %g degrees about %c", m->degrees, axes[m->turn]);
  else if (arc > 1e-6)
    printf(", turning %.4g degrees about %.3g %.3g %.3g", arc, axis[0], axis[1], axis[2]);
  if (m->lines) printf(", by %zu pose%s", m->count, m->count > 1 ? "s" : "");
  if (m->through >= 0)
    printf(": straight through B along %c, where it is thinnest", axes[m->through]);
  printf("\n");
}

#endif
