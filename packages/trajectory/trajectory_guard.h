// SPDX-License-Identifier: MIT
// trajectory_guard.h - is this joint trajectory free? For a controller, or for a plugin of a planner: it has
// a planning file of its robot and scenes (examples/FORMATS.md; examples/robot/urdf.py makes one of a
// URDF), and asks about trajectories as they will be executed, within a bounded time. After
// guard_open nothing is allocated. trajectory_guard.hpp is the same for C++.
#ifndef TRAJECTORY_GUARD_H
#define TRAJECTORY_GUARD_H
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct trajectory_guard trajectory_guard;

// As trajectory_msgs/JointTrajectory has it, and as ros2_control's joint_trajectory_controller goes between
// points: with positions alone on straight lines, with velocities on cubics, with accelerations too
// on quintics. That curve is what is proven.
typedef struct guard_trajectory {
  const double *positions;      // (count, J) radians or metres, in the guard's order of joints
  const double *velocities;     // (count, J) by the second, or NULL
  const double *accelerations;  // (count, J), or NULL; with velocities only
  const double *times;          // (count) seconds, rising: time_from_start
  size_t count;                 // 1 to the guard's most_points; 1: the robot rests
} guard_trajectory;

typedef enum guard_verdict {
  GUARD_UNDECIDED,  // the time was up, or surfaces are too near to tell: take it for a hit
  GUARD_FREE,    // proven: at no time, between points too, does anything come within the clearance
  GUARD_HIT,     // proven: it does, or a joint leaves its limits
  GUARD_REFUSED  // `reason` says what is wrong with the trajectory
} guard_verdict;

typedef struct guard_answer {
  guard_verdict verdict;
  double
      free_until;  // seconds: proven free before this; the end that was asked about if it is free
  // texts live until guard_close; NULL: none
  const char *a, *b;   // the two bodies of a hit, or between which it is undecided
  const char *joint;   // that leaves its limits
  const char *reason;  // why it is refused or undecided
  double seconds;      // that the answer took
} guard_answer;

// Reads a planning file, encodes its meshes, and makes all that later calls need. NULL if that fails. May
// take seconds. Not in two threads at once; where there is no memory the process ends.
//   path         of the planning file; those of its meshes are relative to its folder
//   scene        the name of one of its scenes; NULL: there are no obstacles
//   clearance    metres, to obstacles; the file's clearances hold besides
//   most_points  of a trajectory
//   reason       why it is NULL, a line of at most reason_size - 1 bytes; NULL: on standard error
trajectory_guard *guard_open(const char *path, const char *scene, float clearance,
                             size_t most_points, char *reason, size_t reason_size);
void guard_close(trajectory_guard *guard);  // NULL: nothing happens

// The joints, in the order of the file: names and how many.
size_t guard_joints(const trajectory_guard *guard);
const char *guard_joint_name(const trajectory_guard *guard, size_t joint);

// Is the trajectory free from one time to another? `from` and `to` are clamped to it. seconds: the answer
// is UNDECIDED if it would take longer than that, by a fraction of a millisecond; 0: it may take as
// long as it takes. That is the clock's time: a thread that the kernel does not run is late. Each
// thread needs a guard of its own.
guard_answer guard_check(trajectory_guard *guard, const guard_trajectory *trajectory, double from,
                         double to, double seconds);

// Puts an obstacle elsewhere, as a camera has it: metres, and a unit quaternion x y z w. It rests there for
// later checks: what moves needs a clearance for its way until the robot rests. 0: there is no such
// obstacle, or that is no pose; then nothing has changed.
int guard_move(trajectory_guard *guard, const char *obstacle, const float pose[7]);

#ifdef __cplusplus
}
#endif
#endif  // TRAJECTORY_GUARD_H
