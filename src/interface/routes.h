// In: a robot among obstacles, a start and goals. Out: a motion from the start to a goal, proven
// free.
//
// A straight line is tried first. If it is not free, two trees grow, from the start and from the
// goals, whose edges are proven free. The path that joins them is made shorter, timed, and smoothed
// within the limits of speed and acceleration. In the end the motion is proven as a whole. All of
// it stays in the scene's cones.
#pragma once
#include "robots.h"

// the most nodes of both trees
#define NSVCD_MAX_NODES 10000000

typedef enum nsvcd_route_status {
  // the motion is proven free, within the limits, and ends at a goal
  NSVCD_ROUTE_FOUND = 0,
  // there is no path with as many nodes or tries as options allow; or the path, or a guess, has
  // more than 680 corners
  NSVCD_ROUTE_LIMIT,
  // the caller's `stop` or `abandon` ended the search
  NSVCD_ROUTE_STOPPED,
  // the start is out of its limits or not proven free: answer.check says why
  NSVCD_ROUTE_START,
  // no goal is within its limits and proven free: answer.check says why, of the last one
  NSVCD_ROUTE_GOAL
} nsvcd_route_status;

// The status in a word or two, for people; never NULL.
NSVCDDEF const char *nsvcd_route_status_string(nsvcd_route_status status);

// What is sought. A configuration has a value for each of the scene's F joints, radians or metres.
typedef struct nsvcd_route_problem {
  // (F) the configuration in which the motion begins
  const double *start;
  // (G, F) configurations; the motion ends in one of them
  const double *goals;
  // G, 1 to NSVCD_MAX_NODES
  size_t goal_count;
  // (W, F) corners of a path from the start to a goal, without these two, that may be free, or
  // nearly. NULL: none
  const double *guess;
  // W
  size_t guess_count;
  // called before each proof and each look; may be NULL. If it returns anything but 0, the search
  // ends. A path found by then is still proven as a whole
  int (*stop)(void *user);
  // called as nsvcd_check_options.stop is, also in that last proof, and between looks; may be NULL.
  // If it returns anything but 0, that proof ends as well: so this bounds the time, as there
  int (*abandon)(void *user);
  // passed to both
  void *user;
  // (F) 1: the joint stays where the start has it, and the goals and the guess have that value too.
  // So do joints that mimic it, whose own entries do not count. NULL: all joints may move
  const uint8_t *held;
} nsvcd_route_problem;

// How a route is sought. Zero means the default.
typedef struct nsvcd_route_options {
  // seed of all random numbers; other seeds find other routes
  uint64_t seed;
  // metres: the distance that the parts of a pair keep, in the whole motion; default 0
  float clearance;
  // the most nodes of both trees, up to NSVCD_MAX_NODES; default 20,000
  size_t nodes;
  // the most motions that are checked, free or not, without looks; default 4 times `nodes`. Where
  // nothing is free the trees do not grow, so `nodes` alone would not end the search. What cones
  // refuse counts too, also among looks
  size_t tries;
  // radians or metres: the greatest length of an edge; default 1
  double edge;
  // The most motions that are looked at (nsvcd_look) before edges are proven one by one; what is
  // proven by then counts as 16. Default 200,000. NSVCD_NONE: no looks. If all parts that move have
  // balls, trees, shortcuts and smoothing go by looks, and what they find is proven as a whole, as
  // ever. Where that fails, the path's edges are proven one by one; what hangs on one that is not
  // free is cut off, and the search goes on
  size_t looks;
  // tries to shorten the path, up to NSVCD_MAX_NODES, default 20; and tries to smooth the motion,
  // default 200; with cones three times as many. NSVCD_NONE: no tries
  size_t shortcuts, smoothings;
} nsvcd_route_options;

// What was found.
typedef struct nsvcd_route_answer {
  nsvcd_route_status status;
  // if FOUND: the index of the goal that is reached
  size_t goal;
  // if FOUND: the motion, of degree 2, with times, at rest at both ends. Its arrays are in the
  // memory that was given. It has no pieces if the goal is the start
  nsvcd_joint_motion motion;
  // number of times in between at which the motion rests, where no smooth way round a corner was
  // found
  size_t stops;
  // seconds that the motion takes; and that the straight line would take, if nothing were in its
  // way
  double duration, unhindered;
  // FOUND: the last proof. START and GOAL: what is wrong with the start, or with the last goal
  nsvcd_check_answer check;
  // number of nodes of the trees, of motions checked, and of those among them that were free
  size_t nodes, checks, proven;
  // number of motions looked at
  size_t looks;
} nsvcd_route_answer;

// Bytes that nsvcd_route needs; 0 if the problem or the options are refused.
//   checker    not NULL
//   problem    not NULL
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_route_size(const nsvcd_checker *checker,
                                 const nsvcd_route_problem *problem,
                                 const nsvcd_route_options *options);

// Seeks a motion from the start to a goal on which no pair meets. The same problem and seed give
// the same motion if the checker is opened anew each time; a checker remembers which pairs were hit
// last.
//   checker    not NULL
//   problem    not NULL
//   options    NULL: the defaults
//   memory     (size) bytes, nsvcd_route_size(checker, problem, options) or more, not NULL, aligned
//              to NSVCD_ALIGNMENT; the motion's arrays are in it
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a checker and memory of its own
//   errors     ARGUMENT (NULL), COUNT (of goals, of a guess), ROUTE (nodes, shortcuts, edge), HELD,
//              VALUE (a configuration not finite or beyond NSVCD_MAX_COORDINATE), MIMIC, CLEARANCE,
//              WORKSPACE; POSE, SCALE, as nsvcd_check
//   source     RRT-Connect (Kuffner and LaValle 2000); bounded-acceleration shortcuts (Hauser and
//              Ng-Thow-Hing 2010); paths of edges that are proven last (Bohlin and Kavraki 2000);
//              with cones CBiRRT (Berenson et al. 2009). Difference: edges and shortcuts are
//              proven, not sampled
NSVCDDEF nsvcd_result nsvcd_route(nsvcd_checker *checker, const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, void *memory,
                                  size_t size, nsvcd_route_answer *answer);
