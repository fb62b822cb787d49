// In: a robot in one configuration. Out: what is near, how that changes with the joints, a way out;
// who can meet whom at all; a part as another link would carry it.
#pragma once
#include "robots.h"

// Two parts of a pair that are near each other.
typedef struct nsvcd_proximity {
  // of the scene's
  size_t pair;
  // HIT: they touch, or one is inside of the other, as nsvcd_check has it; FREE: they are proven to
  // be apart; UNDECIDED, and why: too near to tell, or too little work
  nsvcd_verdict verdict;
  nsvcd_why why;
  // metres: no less than `low`, no more than `high`
  nsvcd_range distance;
  // metres, of a HIT: a push-out of a by this along the contact's normal is proven to separate
  // them; hardly less does, along that normal. HUGE_VALF: none up to options.deepest along each
  // normal was found, as where one is inside of the other or held from all sides. 0 of all others
  float depth;
  // where they are nearest, as nsvcd_answer.nearest has it; of a HIT, where they are once they are
  // pushed out, with the push-out's direction as the normal
  nsvcd_contact contact;
  // (F), metres by radian or metre: how the distance between the two places of the contact grows
  // with each joint; of a HIT, how its depth along that normal shrinks. Where other places are as
  // near, or as deep, it is that of one of them. 0 without a normal
  double slope[NSVCD_MAX_JOINTS];
} nsvcd_proximity;

// What is zero is the default. Up to NSVCD_MAX_COORDINATE.
typedef struct nsvcd_proximity_options {
  // metres: pairs that are as near as this are told; 0.05
  float max_distance;
  // metres: how wide a bracket of a distance may be, beside what poses in float are off; 20 um
  float to;
  // metres: how large a depth is told; 20 mm. Much more than there is makes it no better
  float deepest;
  // units that each question may take; NSVCD_DEFAULT_WORK
  size_t work;
} nsvcd_proximity_options;

// All pairs that are near in a configuration: what is wrong with a start or a goal, or what a
// controller is to keep away from.
//   checker    not NULL
//   joints     (F), radians or metres
//   options    NULL: the defaults
//   gaps       (capacity), not NULL unless that is 0; in the order of the pairs. scene.pair_count
//              is always enough. Some may be written on failure
//   count      not NULL: how many there are; where that is more than the capacity, the first are
//              written
//   allocates  nothing
//   threads    each with a checker of its own, as all of this page
//   errors     ARGUMENT, VALUE (joints not finite or beyond NSVCD_MAX_COORDINATE), WITHIN, TO;
//              POSE, SCALE (a part is, or is carried, beyond NSVCD_MAX_COORDINATE)
//   source     this library; slopes as any Jacobian's, by the product of axis and moment arm
NSVCDDEF nsvcd_result nsvcd_proximities(nsvcd_checker *checker, const double *joints,
                                        const nsvcd_proximity_options *options,
                                        nsvcd_proximity *gaps, size_t capacity, size_t *count);

// What is zero is the default.
typedef struct nsvcd_nearest_free_options {
  // metres: the configuration that is sought stays farther apart than this
  float clearance;
  // radians and metres alike: how far it may be, as the root of the sum of squares; 0.5
  double farthest;
  // of the random numbers
  uint64_t seed;
  // asked before each question and each draw; not 0 ends it with what is found by then. May be NULL
  int (*stop)(void *user);
  void *user;
} nsvcd_nearest_free_options;

// A configuration near another one that is proven free, within the limits: a way out of a start or
// a goal that is not. It is sought at random, nearer and nearer, with some hundred configurations,
// and drawn back as far as that can be. What lies in between need not be free.
//   checker    not NULL
//   joints     (F), radians or metres; out of the limits, they are taken in first, and what follows
//              is about these
//   options    NULL: the defaults
//   out        (F), not NULL; the joints themselves where these are free. Left as it was where none
//              is found
//   is_found   not NULL
//   allocates  nothing
//   errors     ARGUMENT, VALUE, CLEARANCE, FARTHEST; POSE, SCALE, as nsvcd_proximities
//   source     this library
NSVCDDEF nsvcd_result nsvcd_nearest_free(nsvcd_checker *checker, const double *joints,
                                         const nsvcd_nearest_free_options *options,
                                         double *out, int *is_found);

// What nsvcd_find_pairs says of pairs: how many of which kind, in this order.
typedef struct nsvcd_pair_counts {
  // to be asked
  size_t asked;
  // of parts on two links that one joint parts, neither of them the world
  size_t adjacent;
  // of others: they touch in all samples. That is no proof that they always do: to be asked, unless
  // the caller knows more
  size_t touching;
} nsvcd_pair_counts;

// Which pairs of parts are to be asked? All on links that differ, but adjacent ones, which joints
// are made to keep apart or to overlap. Those that touch in all samples are told apart from the
// others, not left out: two that separate only in a narrow range of a joint are among them, and a
// motion is proven without a pair only if the caller leaves it out. None is left out for it seems
// never to meet: that costs little.
//   checker    of the parts and joints, whatever pairs its scene has
//   samples    random configurations within the limits, at most, that a pair is looked at in; 0: 64
//   seed       of them
//   pairs      (capacity), not NULL unless that is 0; some may be written on failure
//   capacity   B (B - 1) / 2 is always enough, of B parts
//   counts     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, WORKSPACE (capacity); POSE, SCALE, as nsvcd_proximities
//   source     as setup assistants do (MoveIt's), but none is left out as "never" or "always"
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
//   errors     ARGUMENT, VALUE, LINK (or no such part), POSE (farther than NSVCD_MAX_COORDINATE
//              from the link)
NSVCDDEF nsvcd_result nsvcd_reparent(const nsvcd_checker *checker, const double *joints,
                                     size_t part, uint32_t link, nsvcd_part *out);
