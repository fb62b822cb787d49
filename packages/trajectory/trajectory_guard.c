// SPDX-License-Identifier: MIT
// trajectory_guard.c - trajectory_guard.h, by nsvcd_check and svcd's reader of planning files. Link
// with -lm.
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"  // of svcd's readers not all is needed
#endif
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#define NSVCD_NO_NETWORK
#include "../../neuralsvcd.h"
#include "../../extras/neuralsvcd_certify.h"
#include "../../extras/neuralsvcd_robot.h"
#define PROGRAM "trajectory_guard"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/load.h"
#include "../../examples/scenery/robot_shapes.h"
#include "../../examples/scenery/robot_file.h"
#include "../../examples/scenery/robot_room.h"
#include "trajectory_guard.h"

struct trajectory_guard {
  robot_file file;
  robot_in_room in;
  size_t joints, most_points;
  double *points;   // (NSVCD_MAX_DEGREE (most_points - 1) + 1, joints)
  double *times;    // (most_points)
  double deadline;  // seconds of the clock
  int is_late;      // it was reached
};

trajectory_guard *guard_open(const char *path, const char *scene, float clearance,
                             size_t most_points, char *reason, size_t reason_size) {
  nsvcd_encode_options options;
  trajectory_guard *guard = (trajectory_guard *)allocate(sizeof *guard);
  size_t room = NSVCD_NONE, meshes;
  double taken;
  memset(guard, 0, sizeof *guard);
  memset(&options, 0, sizeof options);
  complaint = reason_size > 0 ? reason : NULL;
  complaint_size = reason_size;
  int good = read_robot(path, &guard->file);
  if (good && scene && !robot_find_room(&guard->file, scene, &room))
    good = complain("%s: no scene %s", path, scene);
  if (good && (most_points < 1 || most_points > SIZE_MAX / 16 / sizeof(double) / NSVCD_MAX_JOINTS))
    good = complain("most_points is 0, or too large");
  if (good && !(clearance >= 0)) good = complain("the clearance is negative, or no number");
  if (good) need_room(&guard->file, room);
  good = good && encode_robot(&guard->file, &options, &meshes, &taken) &&
         enter_room(&guard->file, room, clearance, &guard->in);
  complaint = NULL;
  if (!good) {
    guard_close(guard);
    return NULL;
  }
  guard->joints = guard->file.joint_count;
  guard->most_points = most_points;
  const size_t rows = NSVCD_MAX_DEGREE * (most_points - 1) + 1;
  guard->points = (double *)allocate(rows * guard->joints * sizeof *guard->points);
  guard->times = (double *)allocate(most_points * sizeof *guard->times);
  return guard;
}

void guard_close(trajectory_guard *guard) {
  if (!guard) return;
  leave_room(&guard->in);
  free_robot(&guard->file);
  free(guard->points);
  free(guard->times);
  free(guard);
}

size_t guard_joints(const trajectory_guard *guard) {
  return guard->joints;
}
const char *guard_joint_name(const trajectory_guard *guard, size_t joint) {
  return joint < guard->joints ? guard->file.joint_names[joint] : NULL;
}

// ---- a trajectory as Bezier curves

// The points of one joint between two points of the trajectory (Hermite's ends).
static void guard_curve(const trajectory_guard *guard, const guard_trajectory *t, size_t i,
                        size_t joint, size_t degree, double *out) {
  const double h = t->times[i + 1] - t->times[i];
  const size_t at = i * guard->joints + joint;
  const size_t next = at + guard->joints;
  const double n = (double)degree;
  out[0] = t->positions[at];
  out[degree] = t->positions[next];
  if (degree < 3) return;
  out[1] = out[0] + t->velocities[at] * h / n;
  out[degree - 1] = out[degree] - t->velocities[next] * h / n;
  if (degree < 5) return;
  out[2] = 2 * out[1] - out[0] + t->accelerations[at] * h * h / 20;
  out[3] = 2 * out[4] - out[5] + t->accelerations[next] * h * h / 20;
}

// Cuts a curve to a part of it, in place (de Casteljau).
static void guard_cut(double *p, size_t degree, double from, double to) {
  for (size_t level = 1; level <= degree; level++)
    for (size_t i = degree; i >= level; i--) p[i] = (1 - to) * p[i - 1] + to * p[i];
  for (size_t level = 1; level <= degree && to > 0; level++)
    for (size_t i = 0; i + level <= degree; i++) p[i] += from / to * (p[i + 1] - p[i]);
}

// What is wrong with a trajectory; NULL: nothing. The checker itself looks at its numbers.
static const char *guard_refuses(const trajectory_guard *guard, const guard_trajectory *t) {
  if (!t->positions || t->count < 1 || t->count > guard->most_points)
    return "a trajectory has no points, or more than most_points";
  if (t->accelerations && !t->velocities)
    return "a trajectory has accelerations without velocities";
  if (t->count > 1 && !t->times) return "a trajectory has no times";
  for (size_t i = 0; i < t->count && t->times; i++) {
    if (!(fabs(t->times[i]) <= 1e9) || (i > 0 && !(t->times[i] > t->times[i - 1])))
      return "times do not rise, or are out of range";
  }
  return NULL;
}

// The pieces of a trajectory from one time to another, in the guard's memory.
static nsvcd_joint_motion guard_motion(trajectory_guard *guard, const guard_trajectory *t,
                                       double from, double to) {
  nsvcd_joint_motion out = {0, 1, guard->points, guard->times};
  out.degree = t->accelerations ? 5 : t->velocities ? 3 : 1;
  const size_t joints = guard->joints;
  for (size_t i = 0; i + 1 < t->count; i++) {
    const double begins = t->times[i];
    const double lasts = t->times[i + 1] - begins;
    const double first = from > begins ? (from - begins) / lasts : 0;
    const double last = to < t->times[i + 1] ? (to - begins) / lasts : 1;
    if (!(first < last)) continue;
    for (size_t joint = 0; joint < joints; joint++) {
      double p[NSVCD_MAX_DEGREE + 1];
      double *column = guard->points + out.pieces * out.degree * joints + joint;
      guard_curve(guard, t, i, joint, out.degree, p);
      if (first > 0 || last < 1) guard_cut(p, out.degree, first, last);
      // where the piece before ends this one begins, to the bit
      for (size_t k = out.pieces > 0; k <= out.degree; k++) column[k * joints] = p[k];
    }
    guard->times[out.pieces++] = first > 0 ? from : begins;
    guard->times[out.pieces] = last < 1 ? to : t->times[i + 1];
  }
  if (out.pieces > 0) return out;
  // it rests, at its one point, or at the end that is asked about
  const size_t row = t->count > 1 && from > t->times[0] ? t->count - 1 : 0;
  memcpy(guard->points, t->positions + row * joints, joints * sizeof *guard->points);
  return out;
}

// ---- the question

static int guard_is_late(void *user) {
  trajectory_guard *guard = (trajectory_guard *)user;
  return guard->is_late = seconds() > guard->deadline;
}

guard_answer guard_check(trajectory_guard *guard, const guard_trajectory *trajectory, double from,
                         double to, double seconds_left) {
  const double began = seconds();
  guard_answer out;
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&out, 0, sizeof out);
  memset(&options, 0, sizeof options);
  out.verdict = GUARD_REFUSED;
  out.reason = guard_refuses(guard, trajectory);
  if (!out.reason && !(from <= to)) out.reason = "from is not before to";
  if (out.reason) return out;
  const nsvcd_joint_motion motion = guard_motion(guard, trajectory, from, to);
  guard->deadline = began + seconds_left;
  guard->is_late = 0;
  options.stop = seconds_left > 0 ? guard_is_late : NULL;
  options.user = guard;
  const nsvcd_result result = nsvcd_check(guard->in.checker, &motion, &options, &answer);
  out.seconds = seconds() - began;
  if (result) {
    out.reason = nsvcd_result_string(result);
    return out;
  }
  out.verdict = answer.verdict == NSVCD_FREE  ? GUARD_FREE
                : answer.verdict == NSVCD_HIT ? GUARD_HIT
                                              : GUARD_UNDECIDED;
  out.free_until = answer.free_until;
  if (answer.pair != NSVCD_NONE) {
    out.a = robot_name(&guard->in, guard->in.pairs[answer.pair].a);
    out.b = robot_name(&guard->in, guard->in.pairs[answer.pair].b);
  }
  if (out.verdict == GUARD_UNDECIDED)
    out.reason = guard->is_late                 ? "the time was up"
                 : answer.why == NSVCD_WHY_WORK ? "a pair took too much work"
                                                : "too near to tell";
  if (answer.joint != NSVCD_NONE) {
    out.joint = guard->file.joint_names[answer.joint];
    out.verdict = GUARD_HIT;
  }
  return out;
}

int guard_move(trajectory_guard *guard, const char *obstacle, const float pose[7]) {
  robot_in_room *in = &guard->in;
  const size_t bodies = guard->file.body_count;
  size_t part = bodies;
  while (part < in->scene.part_count && strcmp(robot_name(in, part), obstacle) != 0) part++;
  if (part >= in->scene.part_count) return 0;
  const nsvcd_pose before = in->parts[part].pose;
  nsvcd_pose *now = &in->parts[part].pose;
  memcpy(now->position, pose, sizeof now->position);
  memcpy(now->rotation, pose + 3, sizeof now->rotation);
  // opened again in the same memory: as it was, if that is no pose
  const size_t size = nsvcd_checker_size(&in->scene);
  const int good = size && !nsvcd_checker_open(&in->scene, in->memory, size, &in->checker);
  if (good) return 1;
  *now = before;
  (void)nsvcd_checker_open(&in->scene, in->memory, nsvcd_checker_size(&in->scene), &in->checker);
  return 0;
}
