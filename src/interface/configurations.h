// In: a robot in one configuration. Out: which parts are near each other, and how that changes with
// the joints; the nearest free configuration; which pairs can meet; a part on another link.
#pragma once
#include "robots.h"

// Two parts of a pair that are near each other.
typedef struct nsvcd_proximity {
  // of the scene's
  size_t pair;
  // HIT: they touch, or one is inside of the other. FREE: they are proven to be apart. UNDECIDED:
  // too near to tell, or too little work
  nsvcd_verdict verdict;
  nsvcd_why why;
  // metres: no less than `low`, no more than `high`
  nsvcd_range distance;
  // metres, of a HIT: moving a by this along the contact's normal is proven to separate them, and
  // hardly less along that normal does. HUGE_VALF: no push-out up to options.max_depth was found,
  // as where one is inside of the other or held from all sides. 0 unless it is a HIT
  float depth;
  // where they are nearest, as nsvcd_answer.nearest has it; of a HIT, where they are nearest once
  // pushed out, with the push-out's direction as the normal
  nsvcd_contact contact;
  // (F), metres per radian or metre: how the distance between the two points of the contact grows
  // with each joint; of a HIT, how the depth along its normal shrinks. Where several points are as
  // near, or as deep, it is that of one of them. 0 without a normal
  double slope[NSVCD_MAX_JOINTS];
} nsvcd_proximity;

// Zero means the default. Lengths are at most NSVCD_MAX_COORDINATE.
typedef struct nsvcd_proximity_options {
  // metres: pairs within this of each other are reported; 0.05
  float max_distance;
  // metres: width of the bracket of a distance, beside the rounding of poses to float; 20 um
  float to;
  // metres: larger depths are not found; 20 mm. One much larger than the depths that there are
  // makes none of them better
  float max_depth;
  // units for each question; NSVCD_DEFAULT_WORK
  size_t work;
} nsvcd_proximity_options;

// All pairs of parts that are near each other in a configuration: what is wrong with a start or a
// goal, or what a controller must keep away from.
//   checker    not NULL
//   joints     (F), radians or metres
//   options    NULL: the defaults
//   out        (capacity), not NULL unless that is 0; in the order of the pairs. scene.pair_count
//              is always enough. Some may be written on failure
//   count      not NULL: how many there are; if more than the capacity, the first are written
//   allocates  nothing
//   threads    each with a checker of its own, as in all of this page
//   errors     ARGUMENT, VALUE (joints not finite or beyond NSVCD_MAX_COORDINATE), DISTANCE, TO;
//              POSE, SCALE (a part is, or is carried, beyond NSVCD_MAX_COORDINATE)
//   source     this library; slopes as any Jacobian's, by the product of axis and moment arm
NSVCDDEF nsvcd_result nsvcd_proximities(nsvcd_checker *checker, const double *joints,
                                        const nsvcd_proximity_options *options,
                                        nsvcd_proximity *out, size_t capacity, size_t *count);

// Zero means the default.
typedef struct nsvcd_nearest_free_options {
  // metres: between the parts
  float clearance;
  // radians and metres alike: how far away the configuration may be, Euclidean; 0.5
  double farthest;
  // of the random numbers
  uint64_t seed;
  // called before each question and each draw; if it returns other than 0 the search ends with what
  // it has found. May be NULL
  int (*stop)(void *user);
  void *user;
} nsvcd_nearest_free_options;

// Seeks a configuration, proven free and within the limits, as near as possible to one that is not:
// for a start or a goal that is in contact. Some hundred configurations are drawn at random, nearer
// and nearer; each free one is moved back towards the joints as far as it stays free. What lies in
// between need not be free.
//   checker    not NULL
//   joints     (F), radians or metres; clamped to the limits first
//   options    NULL: the defaults
//   out        (F), not NULL; the joints themselves if they are free. Left as it was if none is
//              found
//   is_found   not NULL
//   allocates  nothing
//   errors     ARGUMENT, VALUE, CLEARANCE, FARTHEST; POSE, SCALE, as nsvcd_proximities
//   source     this library
NSVCDDEF nsvcd_result nsvcd_nearest_free(nsvcd_checker *checker, const double *joints,
                                         const nsvcd_nearest_free_options *options,
                                         double *out, int *is_found);

// Of the pairs that nsvcd_find_pairs writes: how many of each kind, in this order.
typedef struct nsvcd_pair_counts {
  // to be checked
  size_t asked;
  // of parts on the two links of one joint, neither of them the world
  size_t adjacent;
  // of others that touch in all random configurations. That does not prove that they always do: to
  // be checked, unless the caller knows more
  size_t touching;
} nsvcd_pair_counts;

// Which pairs of parts should a scene have? All on different links, but adjacent ones: joints are
// made to keep these apart, or to overlap. Pairs that touch in all random configurations are listed
// apart: two that separate only in a narrow range of a joint are among them. To leave one out is
// the caller's decision. Pairs that seem never to meet are not left out, since they cost little.
//   checker    of the parts and joints, whatever pairs its scene has
//   draws      random configurations within the limits in which a pair is asked about, at most;
//              0: 64
//   seed       of the random numbers
//   pairs      (capacity), not NULL unless that is 0; some may be written on failure
//   capacity   B (B - 1) / 2 is always enough, of B parts
//   counts     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, WORKSPACE (capacity); POSE, SCALE, as nsvcd_proximities
//   source     as setup assistants do (MoveIt's), but none is left out as "never" or "always"
NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t draws, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts);

// The same part on another link, from where it is: to grasp a thing, or, on link 0, to let go of
// it. Put it into the scene, choose its pairs anew, and open a checker.
//   joints     (F), in which the link takes it over
//   part       an index of the scene's parts
//   link       the new one; 0: the world
//   out        not NULL; left as it was on failure. Its pose is rounded to float: 1e-7 of its
//              distance from the link
//   errors     ARGUMENT, VALUE, LINK (or no such part), POSE (farther than NSVCD_MAX_COORDINATE
//              from the link)
NSVCDDEF nsvcd_result nsvcd_reparent(const nsvcd_checker *checker, const double *joints,
                                     size_t part, uint32_t link, nsvcd_part *out);
