// In: a robot in one configuration. Out: what is near, how that changes with the joints, a way out;
// who can meet whom at all; a part as another link would carry it.
#pragma once
#include "robots.h"

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// Two parts of a pair that are near each other.
typedef struct nsvcd_gap {
  // of the scene's
  size_t pair;
  // metres: no less than `low`, no more than `high`. 0, 0: they touch, or one is inside of the
  // other
  nsvcd_range distance;
  // metres, computed, not proven: of parts that touch, how far a is to be lifted off b. 0: they do
  // not touch; HUGE_VALF: by more than options.deepest, or one is inside of the other
  float depth;
  // where: as nsvcd_answer.nearest has it; of parts that touch, its normal is that of the lift, if
  // there is one
  nsvcd_contact contact;
  // (F), metres by radian or metre: how the distance between the two places of the contact changes
  // with each joint; of parts that touch, how the lift that is needed shrinks. 0 without a normal
  double slope[NSVCD_MAX_JOINTS];
} nsvcd_gap;

// What is zero is the default.
typedef struct nsvcd_gap_options {
  // metres: pairs that are as near as this are told; 0.05
  float within;
  // metres: how wide a bracket of a distance may be, beside both bodies' quanta; 0.1 mm
  float to;
  // metres: how deep a depth is told; 20 mm
  float deepest;
  // units that each question may take; NSVCD_DEFAULT_WORK
  size_t work;
} nsvcd_gap_options;

// All pairs that are near in a configuration: what is wrong with a start or a goal, or what a
// controller is to keep away from.
//   checker    not NULL
//   joints     (F), radians or metres
//   options    NULL: the defaults
//   gaps       (capacity), not NULL unless that is 0; in the order of the pairs. scene.pair_count
//              is always enough
//   count      not NULL: how many there are; where that is more than the capacity, the first are
//              written
//   allocates  nothing
//   errors     ARGUMENT, NUMBER (joints not finite or beyond NSVCD_MAX_COORDINATE), TOLERANCE
//   source     this library; slopes by the product of the axis and the lever, as any Jacobian's
NSVCDDEF nsvcd_result nsvcd_gaps(nsvcd_checker *checker, const double *joints,
                                 const nsvcd_gap_options *options, nsvcd_gap *gaps,
                                 size_t capacity, size_t *count);

// What is zero is the default.
typedef struct nsvcd_escape_options {
  // metres: the configuration that is sought stays farther apart than this
  float clearance;
  // radians and metres alike: how far it may be, as the root of the sum of squares; 0.5
  double farthest;
  // of the random numbers
  uint64_t seed;
} nsvcd_escape_options;

// A configuration near another one that is proven free, within the limits: a way out of a start or
// a goal that is not. It is sought at random, nearer and nearer, with some hundred configurations,
// and drawn back as far as that can be. What lies in between is not free.
//   checker    not NULL
//   joints     (F), radians or metres; out of the limits, they are taken in first
//   options    NULL: the defaults
//   out        (F), not NULL; the joints themselves where these are free. Left as it was where none
//              is found
//   is_found   not NULL
//   allocates  nothing
//   errors     ARGUMENT, NUMBER, TOLERANCE
//   source     this library
NSVCDDEF nsvcd_result nsvcd_escape(nsvcd_checker *checker, const double *joints,
                                   const nsvcd_escape_options *options, double *out,
                                   int *is_found);

// What nsvcd_find_pairs says of pairs: how many of which kind, in this order.
typedef struct nsvcd_pair_counts {
  // that can meet: to be asked
  size_t asked;
  // of parts on two links that one joint parts, the world not among them
  size_t adjacent;
  // that touch in all configurations that were tried
  size_t touching;
} nsvcd_pair_counts;

// Which pairs of parts can meet? All on links that differ; those that one joint parts, and those
// that always touch, which are not worth asking, come last. Nothing that may stay apart is left
// out: who never comes near costs little.
//   checker    of the parts and joints, whatever pairs its scene has
//   samples    random configurations within the limits, at most, that a pair is looked at in; 0: 64
//   seed       of them
//   pairs      (capacity), not NULL; left as it was on failure
//   capacity   B (B - 1) / 2 is always enough, of B parts
//   counts     not NULL
//   allocates  nothing
//   errors     ARGUMENT, WORKSPACE (capacity)
//   source     as setup assistants do (MoveIt's), but none is left out as "never"
NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t samples, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts);

// A part as another link would carry it from where it is: to take hold of a thing, or, on link 0,
// to let go of it. Put it into the scene, say which pairs are asked now, and open a checker.
//   joints     (F), where it is taken over
//   part       which, of the scene's
//   link       the new one; 0: the world
//   out        not NULL; left as it was on failure. It is where it was to what a pose in float is
//              off: 1e-7 of its distance from the link
//   errors     ARGUMENT, NUMBER
NSVCDDEF nsvcd_result nsvcd_hand_over(const nsvcd_checker *checker, const double *joints,
                                      size_t part, uint32_t link, nsvcd_part *out);
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS
