// In: a robot among obstacles, a configuration and others to get to. Out: a motion, proven free.
//
// A route is sought by proofs: a straight line, then two trees of edges that are proven free; its
// way is made shorter, timed, and smoothed within the limits of speed and acceleration, and all of
// it is proven as it is handed out.
#pragma once
#include "robots.h"

// of a route's trees
#define NSVCD_MAX_NODES 10000000

typedef enum nsvcd_route_status {
  // the motion is proven free, within the limits, and ends at a goal
  NSVCD_ROUTE_FOUND = 0,
  // as many nodes or tries as options allow, and no way; or one of more than 680 corners, as a
  // guess may be
  NSVCD_ROUTE_LIMIT,
  // by the caller
  NSVCD_ROUTE_STOPPED,
  // the start, or every goal, is out of limits, or not proven free: answer.check says why
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
  // (W, F), from the start to a goal, these left out: a way that may be free, or nearly. NULL: none
  const double *guess;
  size_t guess_count;
  // asked before each proof; not 0 ends the search. What is found by then is not given up: it is
  // still proven as a whole. May be NULL
  int (*stop)(void *user);
  // asked before each question about a pair, also in that last proof; not 0 ends that too, and so
  // bounds the time. May be NULL
  int (*abandon)(void *user);
  void *user;
} nsvcd_route_problem;

// What is zero is the default.
typedef struct nsvcd_route_options {
  // of all random numbers: threads with seeds of their own seek ways of their own
  uint64_t seed;
  // metres: the whole motion stays farther apart than this
  float clearance;
  // of the trees, at most; 20,000
  size_t nodes;
  // motions asked about in search of a way, at most, free or not: where nothing is free the trees
  // do not grow, and nodes alone would never end it; 4 times the nodes
  size_t tries;
  // radians or metres that an edge is long, at most; 1
  double edge;
  // tried on the way, up to NSVCD_MAX_NODES, and on the timed motion; 20 and 200. NSVCD_NONE: none
  size_t shortcuts, smoothings;
} nsvcd_route_options;

typedef struct nsvcd_route_answer {
  nsvcd_route_status status;
  // FOUND: which one is reached
  size_t goal;
  // of degree 2, with times, at rest at both ends; in the memory that was given. Of no pieces where
  // the goal is the start. Of what is FOUND
  nsvcd_joint_motion motion;
  // times within that it rests at, for want of a smooth way round a corner
  size_t stops;
  // seconds: of the motion; and of the straight line if nothing were in its way
  double duration, unhindered;
  // of FOUND: the last proof. Of START and GOAL: what is wrong with it, of the last goal
  nsvcd_check_answer check;
  // of the trees; motions asked about, and those of them that were free
  size_t nodes, checks, proven;
} nsvcd_route_answer;

// Bytes that nsvcd_route needs; 0 if the problem or the options are refused.
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_route_size(const nsvcd_checker *checker,
                                 const nsvcd_route_problem *problem,
                                 const nsvcd_route_options *options);

// Seeks a motion from the start to a goal on which no pair meets. The same problem and seed, the
// same motion, as long as the checker is opened anew for each: it remembers what was hit last.
//   checker    not NULL
//   problem    not NULL
//   options    NULL: the defaults
//   memory     (size) bytes, nsvcd_route_size(checker, problem, options) or more, not NULL, aligned
//              to NSVCD_ALIGNMENT; the motion is in it
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
