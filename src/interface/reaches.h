// In: a robot, a frame on one of its links, and where that is to be. Out: configurations that have
// it there: goals of a route, say.
#pragma once
#include "robots.h"

// What is sought.
typedef struct nsvcd_reach_problem {
  // (F) radians or metres: where the search begins, and what solutions are near to. Joints that do
  // not move the tool against the target keep these values
  const double *start;
  // the tool: a frame on a link. That of a part is {part.link, part.pose}
  uint32_t link;
  nsvcd_pose tool;
  // the target: a frame on another link; on 0: in the world
  uint32_t target_link;
  nsvcd_pose target;
  // metres: the tool's origin may be anywhere in a box about the target's origin. These are half of
  // its sides, along the target's axes; default 0
  float half[3];
  // the tool may turn freely about this axis of its own, of any length; default 0, 0, 0: it may not
  float free_axis[3];
  // called before each start, and as nsvcd_check_options.stop is; may be NULL. If it returns
  // anything but 0, the search ends with what it has found
  int (*stop)(void *user);
  // passed to `stop`
  void *user;
  // (F) 1: the joint stays where the start has it, and so do those that mimic it, whose own entries
  // do not count. NULL: all joints may move
  const uint8_t *held;
} nsvcd_reach_problem;

// How configurations are sought. Zero means the default.
typedef struct nsvcd_reach_options {
  // metres, radians: how far the tool may be off its target; default 1e-6
  double position_tolerance, angle_tolerance;
  // radians or metres: solutions are at least this far apart, Euclidean, with radians and metres
  // alike; default 0.1
  double apart;
  // the most starts: problem.start, then random ones; default 200. After 24 that lead to known
  // solutions, since the last new one, no more follow
  size_t starts;
  // seed of the random numbers
  uint64_t seed;
  // metres: the distance that the parts of a pair keep; default 0
  float clearance;
  // 1: solutions need not be free, and are not checked; they are in the scene's cones all the same
  int may_touch;
} nsvcd_reach_options;

// What was found.
typedef struct nsvcd_reach_answer {
  // number of solutions
  size_t solutions;
  // number of starts; of those that came to the target, in the scene's cones; and of these, of
  // those where the robot was not proven free
  size_t starts, reached, touching;
  // (F) the best configuration that was found: the first solution; where there is none, of those
  // that touch the nearest to the start; else the one that has the tool nearest to the target, and
  // axes to their cones
  double best[NSVCD_MAX_JOINTS];
  // metres, radians: how far the tool is off its target there
  double position_error, angle_error;
  // if `solutions` is 0 and `touching` is not: what is wrong there
  nsvcd_check_answer check;
} nsvcd_reach_answer;

// Finds configurations within the joints' limits, and in the scene's cones, that have a tool at a
// target: several where there are several, such as elbow up and elbow down. By default they are
// proven free, since that is what a route's goal has to be. Where a joint's limits allow values
// that are whole turns apart, the one nearest to the start's is given, but for joints that others
// mimic. Where there are more joints
// than the target needs, there are infinitely many solutions, and some of them are found.
//
// That nothing is found is no proof that there is nothing. Of targets that an arm of 6 or 7 joints
// can reach, fewer than one in a thousand are missed with the default starts (tests/test_reach.c).
//
//   checker    not NULL
//   problem    not NULL
//   options    NULL: the defaults
//   out        (capacity, F) radians or metres, not NULL; solutions, the nearest to the start
//              first, Euclidean. Some may be written on failure
//   capacity   1 or more. The search ends with as many solutions
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a checker of its own
//   errors     ARGUMENT, COUNT (capacity), VALUE (the start not finite or beyond
//              NSVCD_MAX_COORDINATE), MIMIC, LINK (not one of the scene's, or no joint moves the
//              tool against the target), RADIUS (`half`), AXIS (`free_axis`), TOLERANCE, DISTANCE
//              (`apart`), CLEARANCE; POSE, QUATERNION, of the tool or the target; POSE, SCALE, as
//              nsvcd_check
//   source     Levenberg-Marquardt, its damping in proportion to the squared error (Sugihara 2011).
//              Difference: a joint that a step would take beyond a limit is held there in it
NSVCDDEF nsvcd_result nsvcd_reach(nsvcd_checker *checker, const nsvcd_reach_problem *problem,
                                  const nsvcd_reach_options *options, double *out,
                                  size_t capacity, nsvcd_reach_answer *answer);
