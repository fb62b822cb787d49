// In: a robot, and two of its parts. Out: do these ever meet, whatever the joints between them do?
//
// What setup assistants tell from random configurations is proven here, over all values of the
// joints within their limits. Values are cut into boxes. In a box the two parts are apart if a
// plane is between them whatever the joints do; or if a sweep along one of its joints is free, with
// how far the other joints can move a point as a clearance. They meet everywhere in a box if a
// point of both stays inside of both.
#pragma once
#include "robots.h"

// Do two parts meet, or come within the clearance?
typedef enum nsvcd_meeting {
  // it is not known; nsvcd_range_answer.why has the reason
  NSVCD_MEETS_UNKNOWN = 0,
  // they never do, proven
  NSVCD_MEETS_NEVER,
  // they always do, proven
  NSVCD_MEETS_ALWAYS,
  // they do in one configuration, and in another they do not
  NSVCD_MEETS_SOMETIMES
} nsvcd_meeting;

// The answer in one word; never NULL.
NSVCDDEF const char *nsvcd_meeting_string(nsvcd_meeting meeting);

// How it is decided. Zero means the default.
typedef struct nsvcd_range_options {
  // metres: coming within this distance of each other is meeting; default 0
  float clearance;
  // units for each proof of a sweep or a configuration; default NSVCD_DEFAULT_WORK
  size_t work;
  // the most boxes that are looked into, up to NSVCD_MAX_BOXES, which is the default
  size_t boxes;
  // seed of the random numbers
  uint64_t seed;
  // called as nsvcd_check_options.stop is; may be NULL. If it returns anything but 0, the search
  // ends with what it has found
  int (*stop)(void *user);
  // passed to `stop`
  void *user;
  // units of the whole search, approximately, of which a question takes some beside its proof;
  // default 4,000,000
  size_t units;
} nsvcd_range_options;

#define NSVCD_MAX_BOXES 10000000

// What is known of two parts.
typedef struct nsvcd_range_answer {
  nsvcd_meeting meeting;
  // the reason if it is UNKNOWN. TOO_NEAR: somewhere they are too near each other to tell, or they
  // meet but no point was found that stays inside of both. WORK: boxes or units of work were not
  // enough, or the search was stopped. OPEN: as nsvcd_why has it, or they meet wherever that was
  // asked, and all components of one are open, so that no point is known to be inside of it: more
  // work will not tell
  nsvcd_why why;
  // number of joints between the two parts, each leader counted once with those that mimic it; the
  // others do not matter
  size_t joints;
  // 1: a configuration is known in which they do not meet, or in which they do
  int has_free, has_hit;
  // (F) radians or metres: that configuration. A hit is one as nsvcd_check has it
  double free[NSVCD_MAX_JOINTS], hit[NSVCD_MAX_JOINTS];
  // number of boxes looked into; and the fraction of all values that is not decided, 0 if it is
  // known that they never do, or always
  size_t boxes;
  double open;
} nsvcd_range_answer;

// Bytes that nsvcd_pair_range needs; 0 if the pair or the options are refused.
//   checker    may be NULL
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_pair_range_size(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                      const nsvcd_range_options *options);

// Do two parts of a scene ever meet, over all values of the joints between them that are within
// their limits? Joints that are continuous take a full turn.
//   checker    not NULL; made of the parts and joints, whatever pairs its scene has
//   pair       two parts on links that differ
//   options    NULL: the defaults
//   memory     (size) bytes, nsvcd_pair_range_size(checker, pair, options) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs memory of its own; the checker may be shared
//   errors     ARGUMENT, PAIR, CLEARANCE, COUNT (boxes), WORKSPACE; POSE, SCALE, as nsvcd_check
//   source     branch and bound, by a Lipschitz bound; difference: along one joint the motion
//              itself is proven, and joints count by how they move points along a plane's normal
//
// Allowances and cones of the scene do not count.
//
// One joint between the parts takes one proof, two some ten to a thousand boxes, as near as the
// parts come. With more joints SOMETIMES is found soon where it is so, by configurations drawn at
// random and by going down the slope of the distance. NEVER takes the longer the nearer the parts
// come, and the more joints there are.
NSVCDDEF nsvcd_result nsvcd_pair_range(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                       const nsvcd_range_options *options, void *memory,
                                       size_t size, nsvcd_range_answer *answer);

// How far can each joint between two parts move a point of one, as the other sees it, while all
// go about in a box of values? From the centre of the box the distance of the two changes by no
// more than the sum; so they are apart in all of the box if a sweep along one of its joints is free
// with the sum of the others as a clearance. That is what a proof of NSVCD_MEETS_NEVER is made of.
//   checker    not NULL
//   pair       two parts on links that differ
//   low, high  (F) the box, radians or metres, not NULL; joints that are not between the two do not
//              matter. A joint that mimics another counts as one of its own
//   moved      (F) metres, not NULL; 0 for joints that are not between the two
//   allocates  nothing
//   threads    may share the checker
//   errors     ARGUMENT, PAIR; VALUE (not finite, or low above high)
//   source     this library: robot/spans.h
NSVCDDEF nsvcd_result nsvcd_pair_travel(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                        const double *low, const double *high, double *moved);
