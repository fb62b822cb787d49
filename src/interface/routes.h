// In: a robot among obstacles, a configuration and others to get to. Out: a motion, proven free.
//
// A straight line is tried, then two trees grow of edges that are proven free. The path is made
// shorter, timed, and smoothed within the limits of speed and acceleration; the motion is proven
// as a whole before it is handed out.
#pragma once
#include "robots.h"

// of a route's trees
#define NSVCD_MAX_NODES 10000000

typedef enum nsvcd_route_status {
  // the motion is proven free, within the limits, and ends at a goal
  NSVCD_ROUTE_FOUND = 0,
  // no path with as many nodes or tries as options allow; or one of more than 680 corners, as a
  // guess may have
  NSVCD_ROUTE_LIMIT,
  // by the caller
  NSVCD_ROUTE_STOPPED,
  // the start, or every goal, is out of its limits or not proven free: answer.check says why
  NSVCD_ROUTE_START,
  NSVCD_ROUTE_GOAL
} nsvcd_route_status;

// A status in a word or two, for a person; never NULL.
NSVCDDEF const char *nsvcd_route_status_string(nsvcd_route_status status);

typedef struct nsvcd_route_problem {
  // (F)
  const double *start;
  // (G, F); one is enough
  const double *goals;
  size_t goal_count;
  // (W, F): corners of a path from the start to a goal, without these two, that may be free, or
  // nearly. NULL: none
  const double *guess;
  size_t guess_count;
  // called before each proof; if it returns other than 0 the search ends. A path found by then is
  // still proven as a whole. May be NULL
  int (*stop)(void *user);
  // called before each question about a pair, also in that last proof; if it returns other than 0
  // that ends too: a bound of the time. May be NULL
  int (*abandon)(void *user);
  void *user;
} nsvcd_route_problem;

// Zero means the default.
typedef struct nsvcd_route_options {
  // of all random numbers: other seeds find other routes
  uint64_t seed;
  // metres: between the parts, in the whole motion
  float clearance;
  // of the trees, at most; 20,000
  size_t nodes;
  // motions checked, free or not, at most: where nothing is free the trees do not grow, and nodes
  // alone would not end the search; 4 times the nodes
  size_t tries;
  // radians or metres: an edge's length, at most; 1
  double edge;
  // tries to shorten the path, up to NSVCD_MAX_NODES, and to smooth the motion; 20 and 200.
  // NSVCD_NONE: none
  size_t shortcuts, smoothings;
} nsvcd_route_options;

typedef struct nsvcd_route_answer {
  nsvcd_route_status status;
  // if FOUND: which one is reached
  size_t goal;
  // if FOUND: of degree 2, with times, at rest at both ends; in the memory that was given. It has
  // no pieces if the goal is the start
  nsvcd_joint_motion motion;
  // times in between at which it rests, where no smooth motion round a corner was found
  size_t stops;
  // seconds: of the motion; of the straight line, if nothing were in its way
  double duration, unhindered;
  // FOUND: the last proof. START, GOAL: what is wrong with the start, or the last goal
  nsvcd_check_answer check;
  // of the trees; motions checked, and those of them that were free
  size_t nodes, checks, proven;
} nsvcd_route_answer;

// Bytes that nsvcd_route needs; 0 if the problem or the options are refused.
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_route_size(const nsvcd_checker *checker,
                                 const nsvcd_route_problem *problem,
                                 const nsvcd_route_options *options);

// Seeks a motion from the start to a goal on which no pair meets. The same problem and seed give
// the same motion if the checker is opened anew each time, since it remembers what was hit last.
//   checker    not NULL
//   problem    not NULL
//   options    NULL: the defaults
//   memory     (size) bytes, nsvcd_route_size(checker, problem, options) or more, not NULL, aligned
//              to NSVCD_ALIGNMENT; the motion's arrays are in it
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (NULL), COUNT (of goals, of a guess), ROUTE (nodes, shortcuts, edge),
//              VALUE (a configuration not finite or beyond NSVCD_MAX_COORDINATE), CLEARANCE,
//              WORKSPACE
//   source     RRT-Connect (Kuffner and LaValle 2000); bounded-acceleration shortcuts (Hauser and
//              Ng-Thow-Hing 2010); with proofs in place of samples: this library
NSVCDDEF nsvcd_result nsvcd_route(nsvcd_checker *checker, const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, void *memory,
                                  size_t size, nsvcd_route_answer *answer);
