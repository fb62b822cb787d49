// In: a robot in one configuration. Out: which parts are near each other, and how that changes with
// the joints; the nearest free configuration; which pairs can meet; a part on another link.
#pragma once
#include "robots.h"

// Two parts of a pair, a and b, that are near each other.
typedef struct nsvcd_proximity {
  // the pair, an index of the scene's
  size_t pair;
  // HIT: they touch, or one is inside the other. FREE: they are proven to be apart. UNDECIDED: they
  // are too near to tell, or the work was not enough
  nsvcd_verdict verdict;
  // the reason if the verdict is UNDECIDED, or if `distance` is wider than options.to says
  nsvcd_why why;
  // metres: the distance of the two parts
  nsvcd_range distance;
  // metres: how deep a HIT is. Moving a by this along the contact's normal is proven to separate
  // the parts, and hardly less along that normal does. HUGE_VALF: no push-out of up to
  // options.max_depth was found, as where one part is inside the other or held from all sides. 0:
  // it is no HIT
  float depth;
  // where the parts are nearest, as nsvcd_answer.nearest has it. Of a HIT it is where they are
  // nearest once pushed out, and the normal is the push-out's direction
  nsvcd_contact contact;
  // (F) metres per radian or metre: how the distance between the two points of the contact grows
  // with each joint, or, of a HIT, how the depth along its normal shrinks. Where several points are
  // as near, or as deep, the slope is that of one of them. 0: there is no normal. A joint moves
  // those that mimic it, whose own slope is 0
  double slope[NSVCD_MAX_JOINTS];
} nsvcd_proximity;

// What counts as near. Zero means the default. Lengths are at most NSVCD_MAX_COORDINATE.
typedef struct nsvcd_proximity_options {
  // metres: pairs within this distance of each other are reported; default 0.05
  float max_distance;
  // metres: the bracket of a distance is no wider than this and the rounding of poses to float;
  // default 20 um
  float to;
  // metres: depths up to this are found; default 20 mm. A value much larger than the depths that
  // there are makes none of them better
  float max_depth;
  // units for each question; default NSVCD_DEFAULT_WORK
  size_t work;
} nsvcd_proximity_options;

// Finds all pairs of parts that are near each other in a configuration: what is wrong with a start
// or a goal, or what a controller must keep away from.
//   checker    not NULL
//   joints     (F) radians or metres, not NULL
//   options    NULL: the defaults
//   out        (capacity), not NULL unless that is 0; in the order of the scene's pairs. Some may
//              be written on failure
//   capacity   scene.pair_count is always enough
//   count      not NULL; set to how many there are, of which `capacity` at most are written; left
//              as it was on failure
//   allocates  nothing
//   threads    each needs a checker of its own
//   errors     ARGUMENT, VALUE (joints not finite or beyond NSVCD_MAX_COORDINATE), MIMIC,
//              DISTANCE, TO; POSE, SCALE (a part is, or is carried, beyond NSVCD_MAX_COORDINATE)
//   source     this library; slopes as any Jacobian's, by the product of axis and moment arm
NSVCDDEF nsvcd_result nsvcd_proximities(nsvcd_checker *checker, const double *joints,
                                        const nsvcd_proximity_options *options,
                                        nsvcd_proximity *out, size_t capacity, size_t *count);

// How a free configuration is sought. Zero means the default.
typedef struct nsvcd_nearest_free_options {
  // metres: the distance that the parts of a pair keep; default 0
  float clearance;
  // the greatest distance of the configuration from the joints, Euclidean, with radians and metres
  // alike; default 0.5
  double farthest;
  // seed of the random numbers
  uint64_t seed;
  // called before each draw, and as nsvcd_check_options.stop is; may be NULL. If it returns
  // anything but 0, the search ends with what it has found
  int (*stop)(void *user);
  // passed to `stop`
  void *user;
} nsvcd_nearest_free_options;

// Seeks a configuration that is proven free, within the limits and in the scene's cones, as near as
// possible to one that is not, such as a start or a goal in contact. Some hundred configurations
// are drawn at random, nearer and nearer; each free one is moved back towards the joints as far as
// it stays free. What lies in between need not be free.
//   checker    not NULL
//   joints     (F) radians or metres, not NULL; clamped to the limits first
//   options    NULL: the defaults
//   out        (F) radians or metres, not NULL; the joints themselves if they are free. Left as it
//              was if none is found, or on failure
//   is_found   not NULL; 1 if a free configuration is found, else 0. Left as it was on failure
//   allocates  nothing
//   threads    each needs a checker of its own
//   errors     ARGUMENT, VALUE, MIMIC, CLEARANCE, FARTHEST; POSE, SCALE, as nsvcd_proximities
//   source     this library
NSVCDDEF nsvcd_result nsvcd_nearest_free(nsvcd_checker *checker, const double *joints,
                                         const nsvcd_nearest_free_options *options,
                                         double *out, int *is_found);

// How many pairs nsvcd_find_pairs writes of each kind. They are written in this order.
typedef struct nsvcd_pair_counts {
  // pairs to be checked
  size_t asked;
  // pairs of parts on the two links of one joint, neither of them the world
  size_t adjacent;
  // other pairs that touch in all random configurations. That does not prove that they always do:
  // they are to be checked, unless the caller knows more
  size_t touching;
} nsvcd_pair_counts;

// Finds the pairs of parts that a scene should have: all pairs on different links but the adjacent
// ones, which joints are made to keep apart, or to overlap. Pairs that touch in all random
// configurations are listed by themselves, since two that separate only in a narrow range of a
// joint may be among them. To leave one out is the caller's decision. Pairs that seem never to meet
// are not left out, since they cost little. Cones of the scene do not count.
//   checker    not NULL; made of the parts and joints, whatever pairs its scene has
//   draws      the most random configurations, within the limits, in which a pair is asked about;
//              default 64
//   seed       seed of the random numbers
//   pairs      (capacity), not NULL unless that is 0; some may be written on failure
//   capacity   B (B - 1) / 2 is always enough, for B parts
//   counts     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a checker of its own
//   errors     ARGUMENT, WORKSPACE (capacity); POSE, SCALE, as nsvcd_proximities
//   source     setup assistants (MoveIt's); difference: none is left out as "never" or "always"
NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t draws, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts);

// Puts a part on another link, at the place where it is: to grasp a thing, or, on link 0, to let go
// of it. Put the new part into the scene, choose the scene's pairs anew, and open a checker.
//   checker    not NULL
//   joints     (F) radians or metres, not NULL: the configuration in which the link takes it over
//   part       an index of the scene's parts
//   link       the new link; 0: the world
//   out        not NULL; left as it was on failure. Its pose is rounded to float: 1e-7 of its
//              distance from the link
//   allocates  nothing
//   errors     ARGUMENT, VALUE, MIMIC, LINK (or no such part), POSE (farther than
//              NSVCD_MAX_COORDINATE from the link)
NSVCDDEF nsvcd_result nsvcd_reparent(const nsvcd_checker *checker, const double *joints,
                                     size_t part, uint32_t link, nsvcd_part *out);
