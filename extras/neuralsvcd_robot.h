// neuralsvcd_robot.h - v0.3.0 - does a robot, moved by its joints, hit anything?
// SPDX-License-Identifier: MIT
//
// nsvcd_check proves that a motion of the joints is free, as the joints make it; nsvcd_route finds
// one; nsvcd_reach finds configurations that have a tool where it is to be; nsvcd_proximities tells
// which parts are near each other in a configuration. It stands on the public functions of
// neuralsvcd.h. In ONE C or C++ file:
//
//   #define NEURALSVCD_ROBOT_IMPLEMENTATION
//   #include "extras/neuralsvcd_robot.h"
//
// nsvcd_certify_pair is there where neuralsvcd_certify.h is included before it.
//
// CONTENTS: a room's name ends a line of dashes. Each uses only those above it.
//   interface: what a program sees
//     robots          joints, parts, checks of motions; nsvcd_check
//     merges          motions on clocks of their own, as one; nsvcd_merge_motions
//     configurations  one configuration: pairs that are near, a way out
//     ranges          do two parts ever meet, or always? nsvcd_pair_range
//     reaches         configurations that have a tool at a target; nsvcd_reach
//     routes          a start and goals; nsvcd_route
//     pairs           a certificate of a pair of parts; nsvcd_certify_pair
//   ground: numbers and memory
//     compiler        what is asked of the compiler; libc and libm
//     angles          sines and angles, by libm or computed here
//     bits            bits and sizes
//     digests         digests of words
//     valid           is what a caller hands over in order?
//     points          vectors of three, of floats and of doubles
//     rotations       quaternions and matrices, of floats and of doubles
//     motions         between two poses: lines and slerps, in double
//     random          random numbers
//     memory          the allocator; the rows of a workspace
//   robot: is a motion of joints free?
//     chain           links, joints and frames: where everything is
//     mimics          joints that others drive
//     steps           what the joints do between two times
//     allowances      when a pair may touch
//     deviation       how far a part leaves its sweep between two samples
//     checker         the checker of a scene
//     cones           does an axis stay within its cone?
//     samples         configurations of a motion, and boxes about the parts in them
//     local_queries   two parts, in the frame of one of them
//     check           is a motion of the joints free?
//     merge           motions on clocks of their own, as one
//     looks           does a motion seem free?
//     proofs          certificates of pairs
//     rrt             trees of configurations, and the nearest node
//     configurations  proximities, the nearest free one, pairs that can meet
//     cholesky        linear equations
//     reach           configurations that have a tool at a target
//     spans           two parts, and the joints between them
//     meetings        configurations in which two parts meet, and do not
//     partings        does a plane part two parts in a box of values?
//     ranges          do two parts meet never, always or sometimes?
//     blends          from one state to another, within limits of speed and acceleration
//     smooth          a path, timed, then smooth
//     grow            where a tree grows, and edge by edge, in the cones
//     trees           two trees of edges, until they meet
//     route           a path, shortened, as a motion that is proven
//
// GLOSSARY
//   part, link    a body of a scene; what a joint carries
//   piece         one of the curves that a motion of the joints is made of
//   sample, step  a configuration at a time of a motion, with all parts placed; from one to the
//           next
//   sweep         the line and the slerp of a part between its poses at two samples
//   deviation     how far a part leaves its sweep in a step
//   moment arm    how far a point of a part can be from a joint's axis
#ifndef NEURALSVCD_ROBOT_H
#define NEURALSVCD_ROBOT_H
#ifndef NEURALSVCD_H  // include it first where it stands elsewhere
#include "../neuralsvcd.h"
#endif
#ifdef NSVCD_NO_PROOF
#error "neuralsvcd_robot.h: proofs are all it does, and NSVCD_NO_PROOF leaves them out"
#endif

// ================================================================== interface: what a program sees
#ifdef __cplusplus
extern "C" {
#endif

// -------------------------------------------------------------------------------- interface/robots
// In: a robot among obstacles, and a motion of its joints. Out: is that motion free?
//
// The motion is proven free as the joints make it, at all times, and not only at samples. A sweep
// (nsvcd_sweep) moves a part in a line and a slerp from one sample of the motion to the next. The
// joints move it along a curve, which deviates from the sweep by no more than a bound that follows
// from the joints (robot/deviation.h). If the sweep is free with that bound as a clearance, the
// curve is free.

// the largest degree of a piece of a motion
#define NSVCD_MAX_DEGREE 5
#define NSVCD_MAX_PARTS 65536

typedef enum nsvcd_joint_kind {
  NSVCD_JOINT_REVOLUTE = 0,  // turns about its axis, within limits
  NSVCD_JOINT_CONTINUOUS,    // turns without limits
  NSVCD_JOINT_PRISMATIC      // slides along its axis, within limits
} nsvcd_joint_kind;

// A joint of a robot. Joint i carries link i + 1. Link 0 is the world.
//
// A joint that mimics another has a value of its own in each configuration, as all joints have. To
// 1e-9 of 1 and what it is made of, it must be what its leader makes it: else all functions that
// take a configuration refuse it, but for nsvcd_forward_kinematics. What is given back keeps to it.
// The limits of a leader are those within which its followers keep theirs, of speed and
// acceleration as well.
typedef struct nsvcd_joint {
  nsvcd_joint_kind kind;
  // the link that the joint is on: 0..i
  uint32_t parent;
  // the joint's frame, in that link
  nsvcd_pose origin;
  // the joint's axis, in its frame, of any length but 0
  float axis[3];
  // limits of the joint, radians or metres; unused if it is CONTINUOUS
  double low, high;
  // limits of its speed and acceleration, radians or metres per s and per s^2; default 1. Only
  // routes have to keep them
  double speed, acceleration;
  // 1 + the number of the joint that this one mimics, its leader; 0: none. Its value is always
  // multiplier * that of its leader + offset: fingers of a gripper, say. The leader mimics none
  uint32_t mimic;
  // 1e-6 to NSVCD_MAX_COORDINATE, or minus that; a whole number where both joints are CONTINUOUS.
  // Radians or metres
  double multiplier, offset;
} nsvcd_joint;

// A body on a link. A part of link 0 rests.
typedef struct nsvcd_part {
  // a body with triangles
  const nsvcd_body *body;
  // the link's number
  uint32_t link;
  // the body's pose, in the link
  nsvcd_pose pose;
  // scale of the body about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; default 1
  float scale;
} nsvcd_part;

// Contact that is allowed near a configuration: a thing may touch the table that it stands on,
// before a robot takes it, and jaws what they hold. It is allowed while neither part is farther
// than `distance` from where it is in that configuration, as seen from the last link that carries
// both. What counts is a bound of that: over the joints that carry the part alone, how far each is
// from its value there, times how far from its axis the part can ever be, summed. So jaws may touch
// what they hold for good, as long as they do not open.
typedef struct nsvcd_allowance {
  // the pair, an index of the scene's
  size_t pair;
  // (F) the configuration, radians or metres
  const double *joints;
  // metres
  double distance;
} nsvcd_allowance;

// An axis of a part that is kept within a cone, as a cup is that is carried upright.
typedef struct nsvcd_cone {
  // an index of the scene's parts
  uint32_t part;
  // the axis, in the part's frame, and where it is to point, in the world; of any length but 0
  float axis[3], direction[3];
  // radians, more than 0 and less than pi: the most that the axis may be off the direction
  double angle;
} nsvcd_cone;

// A robot and its obstacles. Only the pairs named here are checked.
typedef struct nsvcd_scene {
  // (F) joints of the robot
  const nsvcd_joint *joints;
  // F, up to NSVCD_MAX_JOINTS
  size_t joint_count;
  // (B) parts, of the robot and its obstacles
  const nsvcd_part *parts;
  // B, up to NSVCD_MAX_PARTS
  size_t part_count;
  // (P) pairs of parts that can meet, by their indices. The two parts are on different links
  const nsvcd_body_pair *pairs;
  // P
  size_t pair_count;
  // (P) metres: the distance that each pair keeps, beside the clearance that a check or a route is
  // asked for. NULL: 0 for all
  const float *clearances;
  // (W) where pairs may touch, or be inside of each other
  const nsvcd_allowance *allowances;
  // W
  size_t allowance_count;
  // (C) cones that axes of parts stay within, in all checks, routes and reaches
  const nsvcd_cone *cones;
  // C
  size_t cone_count;
} nsvcd_scene;

// A motion of the joints, in pieces one after another. A piece is a Bezier curve in time. It begins
// where the piece before it ends. The pieces of a polyline have degree 1. Without pieces the robot
// rests in one configuration.
typedef struct nsvcd_joint_motion {
  // number of pieces
  size_t pieces;
  // degree of each piece, 1..NSVCD_MAX_DEGREE; unused without pieces
  size_t degree;
  // (pieces * degree + 1, F) control points of the curves, radians or metres. Two pieces share the
  // point between them
  const double *points;
  // (pieces + 1) times of the pieces' ends, seconds, rising; NULL: each piece takes a second. A
  // motion whose speed does not jump takes fewer sweeps
  const double *times;
} nsvcd_joint_motion;

// Tells where the joints are at a time of a motion.
//   motion     not NULL, as nsvcd_check takes it
//   joints     F, the number of joints
//   time       seconds, as motion->times has them; clamped to the motion
//   out        (F) radians or metres, not NULL
//   allocates  nothing
NSVCDDEF void nsvcd_motion_at(const nsvcd_joint_motion *motion, size_t joints, double time,
                              double *out);

// How a motion is checked. Zero means the default.
typedef struct nsvcd_check_options {
  // metres: parts that come within this distance of each other, and the scene's for their pair, are
  // a hit; default 0
  float clearance;
  // metres: a step of the motion is not cut further if links deviate from their sweeps by less than
  // this in it; default 10 um
  float finest;
  // units for each proof of a pair; default NSVCD_DEFAULT_WORK
  size_t work;
  // called before each question about a pair, about every 1,000 units of its work, while parts are
  // placed, and every 64 steps along a cone; may be NULL. If it returns anything but 0, the check
  // ends UNDECIDED, with NSVCD_WHY_WORK, or with a hit that it has found: within a millisecond or
  // two (`make build/bench_stops`). It is not called again
  int (*stop)(void *user);
  // passed to `stop`
  void *user;
  // seconds, as motion->times has them: of a motion that is not free, also seek until when it is,
  // to this precision; default 0: that is not sought
  double to_time;
} nsvcd_check_options;

// What is known of a motion.
typedef struct nsvcd_check_answer {
  // FREE: at no time of the motion do the parts of a pair come within the clearance, or is one
  // inside the other, but where the scene allows it, and all axes stay in their cones. HIT: in the
  // configuration that is named, those of a pair do, or one is, or an axis is out of its cone
  nsvcd_verdict verdict;
  // the reason if the verdict is UNDECIDED
  nsvcd_why why;
  // the pair that is hit or undecided, an index of the scene's, and the piece of the motion where
  // it is, or where an axis leaves its cone. A HIT need not be the motion's first. NSVCD_NONE:
  // there is none
  size_t pair, piece;
  // fraction of that piece, in [0,1]
  double fraction;
  // the contact of a HIT of a pair, as nsvcd_answer.nearest has it; its time is 0
  nsvcd_contact contact;
  // a joint that leaves its limits somewhere, whatever the verdict; NSVCD_NONE: none does
  size_t joint;
  // number of configurations that parts were placed in, and of questions asked
  size_t placed, sweeps;
  // seconds: the motion is proven free before this time; its end if it is FREE. With
  // options.to_time a HIT is the first one to that precision, unless something before it is
  // undecided: then it is later than this by more
  double free_until;
  // the cone that an axis leaves, or may leave if the verdict is UNDECIDED, an index of the
  // scene's; `pair` is NSVCD_NONE then. NSVCD_NONE: there is none
  size_t cone;
} nsvcd_check_answer;

// A scene, prepared for checks, in the caller's memory.
typedef struct nsvcd_checker nsvcd_checker;

// Bytes that nsvcd_checker_open needs; 0 if the scene is refused.
//   scene      may be NULL
NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene);

// Makes a checker of a scene.
//   scene      not NULL; it and all that it points to must not change while the checker is used
//   memory     (size) bytes, nsvcd_checker_size(scene) or more, not NULL, aligned to
//              NSVCD_ALIGNMENT; the checker is in it
//   checker    not NULL; set to the checker, or left as it was on failure
//   allocates  nothing
//   threads    each needs a checker of its own; scenes may be shared
//   errors     ARGUMENT (NULL), COUNT, WORKSPACE; of a joint JOINT, AXIS, LIMITS (also if a
//              leader's exclude its followers'), SPEED, MIMIC; of a part BODY, VERSION, TRIANGLES,
//              LINK, SCALE; of either POSE, QUATERNION; of a pair PAIR (also if both parts are on
//              one link), CLEARANCE; of an allowance PAIR, ARGUMENT (NULL), VALUE, DISTANCE; of a
//              cone LINK (no such part), AXIS (or its direction), CONE
NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker);

// Tells where the parts are in a configuration, for a picture, say. The poses are rounded to float:
// far from the world's origin, that is coarser than what nsvcd_check computes with.
//   checker    not NULL
//   joints     (F) radians or metres, not NULL; not checked
//   poses      (B) poses of the parts in the world, not NULL
//   allocates  nothing
NSVCDDEF void nsvcd_forward_kinematics(const nsvcd_checker *checker, const double *joints,
                                       nsvcd_pose *poses);

// Is a motion free?
//   checker    not NULL; it remembers which pairs were hit, and asks about them first
//   motion     not NULL
//   options    NULL: the defaults
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a checker of its own
//   errors     ARGUMENT, DEGREE, VALUE (points not finite or beyond NSVCD_MAX_COORDINATE), MIMIC
//              (of points), TIMES, CLEARANCE, FINEST, TO (to_time); POSE, SCALE (a part is, or is
//              carried, beyond NSVCD_MAX_COORDINATE)
//   source     this library: robot/deviation.h bounds how far joints deviate from lines and slerps,
//              by second derivatives
//
// FREE holds for the joints' own motion, with exact joint values and frames, and bodies as
// nsvcd_sweep has them. A HIT is in the configuration named, up to the rounding of a pose to float:
// 1e-7 of the distance between the two parts' origins and of the bodies' extents. Each pair is
// asked about in the frame of one of its parts, so the robot may be far from the world's origin.
// Cones are tested before pairs, in double, without questions. Where the cosine of what an axis is
// off stays within 1e-10 of that of its cone's angle, it may be UNDECIDED: an angle below 2e-5 is
// too narrow for a motion. From the cone's edge inwards, or out to it, a motion is told FREE unless
// that cosine comes within 2e-13 (of up to 32 joints); within 1e-13 no configuration is.
NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer);

// Until when does a motion keep to an allowance, from its start on, or back from its end? For who
// proves the rest of the motion by nsvcd_certify_pair.
//   checker    not NULL
//   allowance  not NULL; it need not be one of the scene's
//   motion     not NULL, as nsvcd_check takes it
//   back       0: from the start on; else back from the end
//   time       not NULL; seconds, as motion->times has them. Not even at its end: that end's time
//   allocates  nothing
//   threads    may share the checker
//   errors     ARGUMENT; PAIR, VALUE, DISTANCE, as nsvcd_checker_open; DEGREE, VALUE, TIMES, as
//              nsvcd_check
//   source     this library: each joint's way times its moment arm, summed
NSVCDDEF nsvcd_result nsvcd_allowed_until(const nsvcd_checker *checker,
                                          const nsvcd_allowance *allowance,
                                          const nsvcd_joint_motion *motion, int back,
                                          double *time);

// -------------------------------------------------------------------------------- interface/merges
// In: motions of some of the joints, each on a clock of its own: two arms, vehicles, a belt. Out:
// one motion of all joints, for nsvcd_check, which finds the first conflict with options.to_time.

// A motion of some of the joints. Before it begins and after it has ended these rest.
typedef struct nsvcd_partial_motion {
  // (pieces * degree + 1, joint_count) points of these joints; else as nsvcd_check takes it
  nsvcd_joint_motion motion;
  // (joint_count) the joints' indices, in the order of the points' columns
  const uint32_t *joints;
  // 1 or more
  size_t joint_count;
  // seconds, added to its times
  double delay;
} nsvcd_partial_motion;

// Bytes that nsvcd_merge_motions needs; 0 if a motion is refused.
//   motions    (count), not NULL unless that is 0
//   joints     F, the number of joints of the scene
NSVCDDEF size_t nsvcd_merge_motions_size(const nsvcd_partial_motion *motions, size_t count,
                                         size_t joints);

// Merges motions of different joints into one. Its pieces begin and end wherever those of a motion
// do, and its degree is the greatest. A moving obstacle is a part on joints that a motion of its
// own moves.
//   motions    (count), not NULL unless that is 0
//   joints     F, the number of joints of the scene, up to NSVCD_MAX_JOINTS
//   rest       (F) radians or metres: where joints are that none of the motions moves. May be NULL
//              if each is moved
//   memory     (size) bytes, nsvcd_merge_motions_size(motions, count, joints) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT; the merged motion's arrays are in it
//   merged     not NULL; left as it was on failure. Without pieces if no motion has any
//   allocates  nothing
//   errors     ARGUMENT, COUNT (joints, joint_count), JOINT (an index is not below F, or two
//              motions move one joint), DEGREE, VALUE (of points or of rest), TIMES (they do not
//              rise, or a piece takes less than 1e-12 of the whole), WORKSPACE
//   source     de Casteljau's algorithm
//
// What a check proves is proven of the merged motion. From the motions it deviates by rounding: a
// joint's values by less than 1e-14 of its greatest, and times by no more than 1e-12 of the whole,
// since pieces that end so close to each other end together.
NSVCDDEF nsvcd_result nsvcd_merge_motions(const nsvcd_partial_motion *motions, size_t count,
                                          size_t joints, const double *rest, void *memory,
                                          size_t size, nsvcd_joint_motion *merged);

// ------------------------------------------------------------------------ interface/configurations
// In: a robot in one configuration. Out: which parts are near each other, and how that changes with
// the joints; the nearest free configuration; which pairs can meet; a part on another link.

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

// -------------------------------------------------------------------------------- interface/ranges
// In: a robot, and two of its parts. Out: do these ever meet, whatever the joints between them do?
//
// What setup assistants tell from random configurations is proven here, over all values of the
// joints within their limits. Values are cut into boxes. In a box the two parts are apart if a
// plane is between them whatever the joints do; or if a sweep along one of its joints is free, with
// how far the other joints can move a point as a clearance. They meet everywhere in a box if a
// point of both stays inside of both.

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

// ------------------------------------------------------------------------------- interface/reaches
// In: a robot, a frame on one of its links, and where that is to be. Out: configurations that have
// it there: goals of a route, say.

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

// -------------------------------------------------------------------------------- interface/routes
// In: a robot among obstacles, a start and goals. Out: a motion from the start to a goal, proven
// free.
//
// A straight line is tried first. If it is not free, two trees grow, from the start and from the
// goals, whose edges are proven free. The path that joins them is made shorter, timed, and smoothed
// within the limits of speed and acceleration. In the end the motion is proven as a whole. All of
// it stays in the scene's cones.

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
#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_ROBOT_H

#if defined(NEURALSVCD_CERTIFY_H) && !defined(NEURALSVCD_ROBOT_PAIRS_H)
#define NEURALSVCD_ROBOT_PAIRS_H
#ifdef __cplusplus
extern "C" {
#endif

// --------------------------------------------------------------------------------- interface/pairs
// In: a pair of a robot's parts, a motion of its joints, and the trees of their meshes. Out: bytes
// that prove that the two parts never meet.

// Bytes of workspace that nsvcd_certify_pair needs: some 300 for each piece of the motion, and 4
// for each vertex of the mesh that has more.
//   motion     not NULL, as nsvcd_check takes it
//   a, b       trees of the meshes of the pair's parts, not NULL
NSVCDDEF size_t nsvcd_certify_pair_workspace_size(const nsvcd_joint_motion *motion,
                                                  const nsvcd_tree *a, const nsvcd_tree *b);

// Proves that a pair of parts never meets, as a motion of the joints moves them, and writes the
// proof: nsvcd_certify for a pair. FREE certificates of all pairs prove that the motion is free
// (examples/verify/nsvcd_verify_robot.h).
//   checker    not NULL
//   motion     not NULL, as nsvcd_check takes it, of one piece or more
//   pair       an index of the scene's pairs
//   clearance  metres
//   a, b       trees of the meshes of the pair's parts, not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_certify_pair_workspace_size or more, not NULL, aligned
//              to NSVCD_ALIGNMENT
//   bytes      (capacity): the certificate, as far as there is room; NULL if capacity is 0
//   made       not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a checker and a workspace of its own; trees may be shared
//   errors     those of nsvcd_certify and nsvcd_check; PAIR; TURN (there are no pieces, or more
//              than NSVCD_MAX_POSES; or a piece takes less than 1e-9 of the motion's time; or a
//              joint is turned to more than 250 radians; or it moves as fast as 100,000 radians
//              or metres in the motion's time)
//   source     this library
NSVCDDEF nsvcd_result nsvcd_certify_pair(const nsvcd_checker *checker,
                                         const nsvcd_joint_motion *motion, size_t pair,
                                         float clearance, const nsvcd_tree *a,
                                         const nsvcd_tree *b,
                                         const nsvcd_certify_options *options, void *workspace,
                                         size_t workspace_size, uint8_t *bytes,
                                         size_t capacity, nsvcd_certificate *made);
#ifdef __cplusplus
}
#endif
#endif

// ================================================================================== IMPLEMENTATION
#if defined(NEURALSVCD_ROBOT_IMPLEMENTATION) && !defined(NEURALSVCD_ROBOT_IMPLEMENTED)
#define NEURALSVCD_ROBOT_IMPLEMENTED
#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // of ground, not all is needed
#endif

// ====================================================================== ground: numbers and memory

// --------------------------------------------------------------------------------- ground/compiler
#ifndef NSVCD__HAS_GROUND_COMPILER
#define NSVCD__HAS_GROUND_COMPILER
// In: the compiler at hand. Out: libc and libm, and how functions are inlined.

#ifdef __TINYC__  // 0.9.27: if a struct and a float, both returned by calls, are passed together
#error "neuralsvcd.h: tcc passes arguments wrongly, and certificates would be false"
#endif
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifndef NSVCD_NO_STDIO
#include <stdio.h>
#endif
// NSVCD_ONE_PATH: nothing may be fused or computed more exactly than it is written.
#ifdef NSVCD_ONE_PATH
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16)
#error \
    "neuralsvcd.h: NSVCD_ONE_PATH: not with -ffast-math, nor where floats are computed in double"
#endif
// gcc has a flag for that, and a pragma that slows everything down tenfold.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif
#endif
// For functions in which sums and differences of products stand side by side: there gcc 12 fuses
// whatever it is told (vfmaddsub).
#if defined(NSVCD_ONE_PATH) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNFUSED \
  static __attribute__((noinline, unused, optimize("no-tree-slp-vectorize")))
#else
#define NSVCD__UNFUSED static inline
#endif
// For functions that take less stack and flash if they are inlined.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__FORCE_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define NSVCD__FORCE_INLINE static __forceinline
#else
#define NSVCD__FORCE_INLINE static inline
#endif
// For functions whose loops over constant arguments must be unrolled. Left to itself, gcc may not
// inline them, and the decoder takes four times as long (tests/bench/PERFORMANCE.md).
#ifdef __OPTIMIZE_SIZE__
#define NSVCD__INLINE static inline
#else
#define NSVCD__INLINE NSVCD__FORCE_INLINE
#endif
// For functions whose stack would add up in a caller.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__NOINLINE __attribute__((noinline))
#elif defined(_MSC_VER)
#define NSVCD__NOINLINE __declspec(noinline)
#else
#define NSVCD__NOINLINE
#endif
#if defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNROLL _Pragma("GCC unroll 8")  // at -O2 too, so that sums stay in registers
#define NSVCD__O3 __attribute__((optimize("O3")))  // short loops, that -O2 leaves as they are
#else
#define NSVCD__UNROLL
#define NSVCD__O3
#endif
#endif  // NSVCD__HAS_GROUND_COMPILER

// ----------------------------------------------------------------------------------- ground/angles
#ifndef NSVCD__HAS_GROUND_ANGLES
#define NSVCD__HAS_GROUND_ANGLES
// In: angles up to a quarter turn, and lengths. Out: sines, and angles. By libm; with
// NSVCD_ONE_PATH computed here, because libm's last digit differs between machines.

#ifdef NSVCD_ONE_PATH
// sin x for 0 <= x <= pi / 2, to 1e-15: the rest of the series is below 2e-18.
static inline double nsvcd__sin(double x) {
  const double square = x * x;
  double sum = 1;
  for (int n = 20; n > 0; n -= 2) sum = 1 - sum * (square / (n * (n + 1)));
  return x * sum;
}
// The angle of a vector (x, y), x, y >= 0, to 1e-15. tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a))
// halves it twice, to below 0.2, where the rest of the series is below 1e-18.
static inline double nsvcd__atan2(double y, double x) {
  const int steep = y > x;
  const double slope = steep ? x / y : x > 0 ? y / x : 0;
  double t = slope;
  double sum = 0;
  for (int n = 0; n < 2; n++) t = t / (1 + sqrt(1 + t * t));
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n - sum * (t * t);
  return steep ? 1.57079632679489662 - 4 * t * sum : 4 * t * sum;
}
static inline float nsvcd__sinf(float x) {
  return (float)nsvcd__sin((double)x);
}
// For 0 <= x < 1.
static inline float nsvcd__asinf(float x) {
  const double sine = (double)x;
  return (float)nsvcd__atan2(sine, sqrt(1 - sine * sine));
}
#else
#define nsvcd__sin sin
#define nsvcd__atan2 atan2
#define nsvcd__sinf sinf
#define nsvcd__asinf asinf
#endif
#endif  // NSVCD__HAS_GROUND_ANGLES

// ------------------------------------------------------------------------------------- ground/bits
#ifndef NSVCD__HAS_GROUND_BITS
#define NSVCD__HAS_GROUND_BITS
// In: whole numbers, and floats. Out: bits that are set, sizes rounded up, floats as bits.

// The index of the lowest bit that is set, of a number that is not 0.
static size_t nsvcd__low_bit(uint64_t bits) {
#if defined(__GNUC__) || defined(__clang__)
  return (size_t)__builtin_ctzll(bits);
#else
  size_t n = 0;
  while (!(bits >> n & 1)) n++;
  return n;
#endif
}

static size_t nsvcd__bit_count(uint64_t bits) {
#if defined(__GNUC__) || defined(__clang__)
  return (size_t)__builtin_popcountll(bits);
#else
  size_t n = 0;
  for (; bits; bits &= bits - 1) n++;
  return n;
#endif
}

static size_t nsvcd__round_up(size_t n, size_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

// |x| as bits, which are ordered as |x| is; infinity and NaN are above all numbers.
static uint32_t nsvcd__magnitude(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits & 0x7fffffffu;
}
static inline int nsvcd__is_finite(float x) {
  return nsvcd__magnitude(x) < 0x7f800000u;
}
#endif  // NSVCD__HAS_GROUND_BITS

// ---------------------------------------------------------------------------------- ground/digests
#ifndef NSVCD__HAS_GROUND_DIGESTS
#define NSVCD__HAS_GROUND_DIGESTS
// In: words of 32 bits. Out: a digest of them.

// Continues a digest over (count) words of 32 bits.
static uint32_t nsvcd__digest(uint32_t digest, const void *words, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint32_t word;
    memcpy(&word, (const char *)words + 4 * i, 4);
    digest = (digest ^ word) * 0x9e3779b1u;
    digest ^= digest >> 15;
  }
  return digest;
}
#endif  // NSVCD__HAS_GROUND_DIGESTS

// ------------------------------------------------------------------------------------ ground/valid
#ifndef NSVCD__HAS_GROUND_VALID
#define NSVCD__HAS_GROUND_VALID
// In: what a caller passes. Out: is it valid?

#define NSVCD__MAX_COUNT 0x7fffffffu  // vertices and triangles: 2^31 - 1

static int nsvcd__is_aligned(const void *memory) {
  return ((uintptr_t)memory & (NSVCD_ALIGNMENT - 1)) == 0;
}

// Are numbers finite, and their absolute values at most `most`? By their bits, so that it holds
// under -ffast-math too.
static NSVCD__NOINLINE int nsvcd__in_range(const float *values, size_t count, float most) {
  for (size_t i = 0; i < count; i++) {
    if (!nsvcd__is_finite(values[i]) || fabsf(values[i]) > most) return 0;
  }
  return 1;
}

// A float that is not less than x >= 0.
static inline float nsvcd__above(double x) {
  return (float)(x * (1 + 2e-7)) + 1e-37f;
}

// Is it a valid length, or 0?
static int nsvcd__is_length(float x) {
  return nsvcd__is_finite(x) && x >= 0 && x <= NSVCD_MAX_COORDINATE;
}

// Are all numbers in range and all quaternions of unit length?
static nsvcd_result nsvcd__poses_check(const nsvcd_pose *poses, size_t count) {
  const float *numbers = poses->position;  // 7 to a pose
  uint32_t most = 0;
  float shortest = 1;
  float longest = 1;
  for (size_t k = 0; k < 7 * count; k++) {
    const uint32_t bits = nsvcd__magnitude(numbers[k]);
    most = bits > most ? bits : most;
  }
  for (size_t k = 0; k < count; k++) {
    const float *q = poses[k].rotation;
    const float square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
    shortest = square < shortest ? square : shortest;
    longest = square > longest ? square : longest;
  }
  const int is_unit =
      shortest >= 1 - 2 * NSVCD_UNIT_TOLERANCE && longest <= 1 + 2 * NSVCD_UNIT_TOLERANCE;
  if (is_unit && most <= nsvcd__magnitude(NSVCD_MAX_COORDINATE)) return NSVCD_OK;
  for (size_t k = 0; k < count; k++) {
    if (!nsvcd__in_range(poses[k].position, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_POSE;
  }
  return NSVCD_ERROR_QUATERNION;
}

// Do times rise from 0 to 1, if there are any?
static int nsvcd__times_are_valid(const float *times, size_t count) {
  if (!times || count == 1) return 1;
  const float last = times[count - 1];
  int rise = !(times[0] < 0) && !(times[0] > 0) && last <= 1 && last >= 1;
  for (size_t k = 1; k < count; k++)  // NaN does not rise
    rise &= (double)times[k] - (double)times[k - 1] >= 0.99e-7;
  return rise;
}

// The pose of a mover without poses.
static const nsvcd_pose nsvcd__at_origin = {{0, 0, 0}, {0, 0, 0, 1}};

// A mover's scale; the default is 1.
static float nsvcd__scale_of(const nsvcd_mover *mover) {
  return mover->scale > 0 ? mover->scale : 1;
}

static size_t nsvcd__pose_count(const nsvcd_mover *mover) {
  return mover->poses ? mover->count : 1;
}

static nsvcd_result nsvcd__track_check(const nsvcd_mover *mover) {
  const float scale = nsvcd__scale_of(mover);
  const float most = NSVCD_MAX_COORDINATE / (scale > 1 ? scale : 1);
  if (!nsvcd__in_range(mover->pivot, 3, most)) return NSVCD_ERROR_PIVOT;
  if (!mover->poses) return mover->count == 0 ? NSVCD_OK : NSVCD_ERROR_POSES;
  if (mover->count < 1 || mover->count > NSVCD_MAX_POSES) return NSVCD_ERROR_POSES;
  if (!nsvcd__times_are_valid(mover->times, mover->count)) return NSVCD_ERROR_TIMES;
  return nsvcd__poses_check(mover->poses, mover->count);
}

// A mesh may come from anywhere: all that follows relies on these checks.
static inline nsvcd_result nsvcd__mesh_check(const nsvcd_mesh *mesh) {
  if (!mesh) return NSVCD_ERROR_ARGUMENT;
  if (mesh->triangle_count == 0) return NSVCD_ERROR_EMPTY;
  if (!mesh->positions || !mesh->indices) return NSVCD_ERROR_ARGUMENT;
  const size_t vertices = mesh->vertex_count;
  const size_t triangles = mesh->triangle_count;
  if (vertices > NSVCD__MAX_COUNT || triangles > NSVCD__MAX_COUNT)
    return NSVCD_ERROR_TOO_LARGE;
  for (size_t i = 0; i < 3 * triangles; i++) {
    if (mesh->indices[i] >= vertices) return NSVCD_ERROR_INDEX;
  }
  if (!nsvcd__in_range(mesh->positions, 3 * vertices, NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  return NSVCD_OK;
}
#endif  // NSVCD__HAS_GROUND_VALID

// ----------------------------------------------------------------------------------- ground/points
#ifndef NSVCD__HAS_GROUND_POINTS
#define NSVCD__HAS_GROUND_POINTS
// In, out: vectors of three numbers, as values: f3 of floats, d3 of doubles. A box is two corners.

// The greater, or the lesser, of two; b if one is NaN. fmax and fmin, which handle NaN, are calls
// with most compilers.
static inline double nsvcd__max(double a, double b) {
  return a > b ? a : b;
}
static inline double nsvcd__min(double a, double b) {
  return a < b ? a : b;
}

// The algebra of f3 and of d3: NSVCD__VECTORS(nsvcd__f3, float, sqrtf) writes nsvcd__f3_add and so
// on. _load and _row read floats, three to a row; _fma(s, b, a) is s b + a, rounded twice. In
// double, differences of floats and what is built of a few of them are practically exact.
#define NSVCD__VECTORS(t, scalar, sqrt) \
  typedef struct t { \
    scalar x, y, z; \
  } t; \
  static inline t t##_of(scalar x, scalar y, scalar z) { \
    const t out = {x, y, z}; \
    return out; \
  } \
  static inline t t##_load(const float *p) { \
    return t##_of((scalar)p[0], (scalar)p[1], (scalar)p[2]); \
  } \
  static inline t t##_row(const float *rows, size_t i) { \
    return t##_load(rows + 3 * i); \
  } \
  static inline t t##_add(t a, t b) { \
    return t##_of(a.x + b.x, a.y + b.y, a.z + b.z); \
  } \
  static inline t t##_sub(t a, t b) { \
    return t##_of(a.x - b.x, a.y - b.y, a.z - b.z); \
  } \
  static inline t t##_scale(t a, scalar s) { \
    return t##_of(s * a.x, s * a.y, s * a.z); \
  } \
  static inline t t##_fma(scalar s, t b, t a) { \
    return t##_of(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z); \
  } \
  static inline t t##_min(t a, t b) { \
    return t##_of(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z); \
  } \
  static inline t t##_max(t a, t b) { \
    return t##_of(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z); \
  } \
  static inline scalar t##_dot(t a, t b) { \
    return a.x * b.x + a.y * b.y + a.z * b.z; \
  } \
  static inline t t##_cross(t a, t b) { \
    return t##_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); \
  } \
  static inline scalar t##_norm(t a) { \
    return sqrt(t##_dot(a, a)); \
  }
NSVCD__VECTORS(nsvcd__f3, float, sqrtf)
NSVCD__VECTORS(nsvcd__d3, double, sqrt)
#undef NSVCD__VECTORS

// ---- floats

// From, and to, rows of x, y and z, `stride` apart.
static inline nsvcd__f3 nsvcd__f3_get(const float *rows, size_t stride) {
  return nsvcd__f3_of(rows[0], rows[stride], rows[2 * stride]);
}
static inline void nsvcd__f3_put(nsvcd__f3 a, float *rows, size_t stride) {
  rows[0] = a.x;
  rows[stride] = a.y;
  rows[2 * stride] = a.z;
}
static inline void nsvcd__f3_store(nsvcd__f3 a, float *p) {
  nsvcd__f3_put(a, p, 1);
}
// Is any component of a greater than b's?
static inline int nsvcd__f3_exceeds(nsvcd__f3 a, nsvcd__f3 b) {
  return (a.x > b.x) | (a.y > b.y) | (a.z > b.z);
}

// A box along the axes.
typedef struct nsvcd__box {
  nsvcd__f3 low, high;
} nsvcd__box;

// Component 0, 1 or 2.
static inline double nsvcd__d3_axis(nsvcd__d3 a, size_t axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
static inline void nsvcd__d3_set_axis(nsvcd__d3 *a, size_t axis, double to) {
  *(axis == 0 ? &a->x : axis == 1 ? &a->y : &a->z) = to;
}
// The axis of the greatest component; of equals the first.
static inline size_t nsvcd__d3_longest(nsvcd__d3 a) {
  if (a.y > a.x && a.y >= a.z) return 1;
  return a.z > a.x ? 2 : 0;
}
static inline nsvcd__d3 nsvcd__d3_over(nsvcd__d3 a, double s) {
  return nsvcd__d3_of(a.x / s, a.y / s, a.z / s);
}
static inline nsvcd__f3 nsvcd__d3_narrow(nsvcd__d3 a) {
  return nsvcd__f3_of((float)a.x, (float)a.y, (float)a.z);
}
// a + t (b - a).
static inline nsvcd__d3 nsvcd__d3_mix(nsvcd__d3 a, nsvcd__d3 b, double t) {
  return nsvcd__d3_add(a, nsvcd__d3_scale(nsvcd__d3_sub(b, a), t));
}
static inline double nsvcd__d3_distance2(nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 offset = nsvcd__d3_sub(a, b);
  return nsvcd__d3_dot(offset, offset);
}
// Of length 1; `otherwise` if a is 0.
static inline nsvcd__d3 nsvcd__d3_unit(nsvcd__d3 a, nsvcd__d3 otherwise) {
  const double length = nsvcd__d3_norm(a);
  return length > 0 ? nsvcd__d3_scale(a, 1 / length) : otherwise;
}
// Rounds for certain. gcc 12 at -O2 drops both conversions where two neighbouring doubles become
// floats and doubles again, and a proof built on the stored floats would not hold. clang 14 for
// WebAssembly, in turn, reads a volatile number that fills a vector a second time, when it may have
// been overwritten.
static inline float nsvcd__to_float(double x) {
#ifdef __wasm_simd128__
  return (float)x;
#else
  volatile float rounded = (float)x;
  return rounded;
#endif
}
static inline nsvcd__f3 nsvcd__f3_round(nsvcd__d3 a) {
  return nsvcd__f3_of(nsvcd__to_float(a.x), nsvcd__to_float(a.y), nsvcd__to_float(a.z));
}
static inline nsvcd__d3 nsvcd__d3_widen(nsvcd__f3 a) {
  return nsvcd__d3_of((double)a.x, (double)a.y, (double)a.z);
}
// Rounded to double where registers are wider (x87), so that it equals itself computed again.
static inline double nsvcd__stored(double x) {
#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1
  return x;
#else
  volatile double rounded = x;
  return rounded;
#endif
}
static inline nsvcd__d3 nsvcd__d3_stored(nsvcd__d3 a) {
  return nsvcd__d3_of(nsvcd__stored(a.x), nsvcd__stored(a.y), nsvcd__stored(a.z));
}
#endif  // NSVCD__HAS_GROUND_POINTS

// -------------------------------------------------------------------------------- ground/rotations
#ifndef NSVCD__HAS_GROUND_ROTATIONS
#define NSVCD__HAS_GROUND_ROTATIONS
// In, out: rotations, as values: quat and mat3 of floats, dquat and dmat3 of doubles. A matrix is
// its rows. A transform is a rotation and a position.

// The algebra of both: NSVCD__ROTATIONS writes nsvcd__quat_dot, nsvcd__mat3_apply and so on.
//   _fma(s, b, a)        s b + a
//   _axis, _inverse      of a unit quaternion; the axis times the sine of half its angle
//   _mul(a, b)           the rotation by b, then by a
//   _turn(a, b)          from a to b, both unit: the axis, times the sine of half the angle
//   _along(a, b, arc, u) the slerp from a to b, which are that arc apart, at fraction u: of any
//                        length. Up to the arc `least` a line is as good, to rounding
//   _of                  the matrix of a unit quaternion
//   _apply_transpose     the transpose of m, times a
//   _transform           rotation a + position
#define NSVCD__ROTATIONS(quat, mat, placed, vec, scalar, sqrt, sin, least) \
  typedef struct quat { \
    scalar x, y, z, w; \
  } quat; \
  typedef struct mat { \
    vec x, y, z; \
  } mat; \
  typedef struct placed { \
    mat rotation; \
    vec position; \
  } placed; \
  static inline scalar quat##_dot(quat a, quat b) { \
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; \
  } \
  static inline quat quat##_scale(quat q, scalar s) { \
    const quat out = {q.x * s, q.y * s, q.z * s, q.w * s}; \
    return out; \
  } \
  static inline quat quat##_fma(scalar s, quat b, quat a) { \
    const quat out = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z, a.w + s * b.w}; \
    return out; \
  } \
  NSVCD__FORCE_INLINE quat quat##_unit(quat q) { \
    return quat##_scale(q, 1 / sqrt(quat##_dot(q, q))); \
  } \
  static inline vec quat##_axis(quat q) { \
    return vec##_of(q.x, q.y, q.z); \
  } \
  static inline quat quat##_inverse(quat q) { \
    const quat out = {-q.x, -q.y, -q.z, q.w}; \
    return out; \
  } \
  static inline quat quat##_mul(quat a, quat b) { \
    quat out; \
    out.x = a.w * b.x + a.x * b.w + (a.y * b.z - a.z * b.y); \
    out.y = a.w * b.y + a.y * b.w + (a.z * b.x - a.x * b.z); \
    out.z = a.w * b.z + a.z * b.w + (a.x * b.y - a.y * b.x); \
    out.w = a.w * b.w - (a.x * b.x + a.y * b.y + a.z * b.z); \
    return out; \
  } \
  static inline vec quat##_turn(quat a, quat b) { \
    return quat##_axis(quat##_mul(b, quat##_inverse(a))); \
  } \
  static inline quat quat##_along(quat a, quat b, scalar arc, scalar u) { \
    const int bends = arc > least; \
    const scalar before = bends ? sin((1 - u) * arc) : 1 - u; \
    const scalar after = bends ? sin(u * arc) : u; \
    return quat##_fma(after, b, quat##_scale(a, before)); \
  } \
  NSVCD__UNFUSED mat mat##_of(quat q) { \
    mat m; \
    m.x.x = 1 - 2 * (q.y * q.y + q.z * q.z); \
    m.x.y = 2 * (q.x * q.y - q.z * q.w); \
    m.x.z = 2 * (q.x * q.z + q.y * q.w); \
    m.y.x = 2 * (q.x * q.y + q.z * q.w); \
    m.y.y = 1 - 2 * (q.x * q.x + q.z * q.z); \
    m.y.z = 2 * (q.y * q.z - q.x * q.w); \
    m.z.x = 2 * (q.x * q.z - q.y * q.w); \
    m.z.y = 2 * (q.y * q.z + q.x * q.w); \
    m.z.z = 1 - 2 * (q.x * q.x + q.y * q.y); \
    return m; \
  } \
  static inline mat mat##_transpose(mat m) { \
    const mat out = {vec##_of(m.x.x, m.y.x, m.z.x), vec##_of(m.x.y, m.y.y, m.z.y), \
                     vec##_of(m.x.z, m.y.z, m.z.z)}; \
    return out; \
  } \
  static inline vec mat##_apply(const mat *m, vec a) { \
    return vec##_of(vec##_dot(m->x, a), vec##_dot(m->y, a), vec##_dot(m->z, a)); \
  } \
  static inline vec mat##_apply_transpose(const mat *m, vec a) { \
    const mat back = mat##_transpose(*m); \
    return mat##_apply(&back, a); \
  } \
  static inline vec vec##_transform(const placed *t, vec a) { \
    return vec##_add(mat##_apply(&t->rotation, a), t->position); \
  }
NSVCD__ROTATIONS(nsvcd__quat, nsvcd__mat3, nsvcd__transform, nsvcd__f3, float, sqrtf,
                 nsvcd__sinf, 1e-3f)
NSVCD__ROTATIONS(nsvcd__dquat, nsvcd__dmat3, nsvcd__dtransform, nsvcd__d3, double, sqrt,
                 nsvcd__sin, 1e-7)
#undef NSVCD__ROTATIONS

static inline nsvcd__dmat3 nsvcd__dmat3_scale(const nsvcd__dmat3 *m, double s) {
  const nsvcd__dmat3 out = {nsvcd__d3_scale(m->x, s), nsvcd__d3_scale(m->y, s),
                            nsvcd__d3_scale(m->z, s)};
  return out;
}

// ---- quaternions and matrices of floats

static inline nsvcd__quat nsvcd__quat_of(float x, float y, float z, float w) {
  const nsvcd__quat out = {x, y, z, w};
  return out;
}
static inline nsvcd__quat nsvcd__quat_load(const float *p) {
  return nsvcd__quat_of(p[0], p[1], p[2], p[3]);
}
// To rows of x, y, z and w, `stride` apart.
static inline void nsvcd__quat_put(nsvcd__quat q, float *rows, size_t stride) {
  rows[0] = q.x;
  rows[stride] = q.y;
  rows[2 * stride] = q.z;
  rows[3 * stride] = q.w;
}
static inline void nsvcd__quat_store(nsvcd__quat q, float *p) {
  nsvcd__quat_put(q, p, 1);
}

// Is the shorter arc from a to b the one to -b? Products of floats are exact in double, so every
// machine agrees, and so do poses in float and in double, even if both arcs are equally long to
// rounding.
static inline int nsvcd__quats_opposed(nsvcd__quat a, nsvcd__quat b) {
  double dot = (double)a.x * (double)b.x;
  dot = nsvcd__stored(dot + (double)a.y * (double)b.y);
  dot = nsvcd__stored(dot + (double)a.z * (double)b.z);
  dot = nsvcd__stored(dot + (double)a.w * (double)b.w);
  return dot < 0;
}

// The length of the arc from a to b in quaternion space: half the angle of rotation, in [0, pi/2]
// for the shorter arc. From the chord, because acos of a dot product near 1 has no digits left.
static inline float nsvcd__quat_arc(nsvcd__quat a, nsvcd__quat b) {
  const nsvcd__quat chord = nsvcd__quat_fma(-1, b, a);
  return 2 * nsvcd__asinf(0.5f * sqrtf(nsvcd__quat_dot(chord, chord)));
}

// The same rotation, negated if it is opposed to another quaternion.
static inline nsvcd__quat nsvcd__quat_beside(nsvcd__quat q, int opposed) {
  return opposed ? nsvcd__quat_of(-q.x, -q.y, -q.z, -q.w) : q;
}

// From a at u = 0 to b at u = 1, on the shorter arc. a, b: unit to 1e-4.
static inline nsvcd__quat nsvcd__quat_slerp(nsvcd__quat a, nsvcd__quat b, float u) {
  const int opposed = nsvcd__quats_opposed(a, b);
  const nsvcd__quat start = nsvcd__quat_unit(a);
  const nsvcd__quat end = nsvcd__quat_beside(nsvcd__quat_unit(b), opposed);
  const float arc = nsvcd__quat_arc(start, end);
  return nsvcd__quat_unit(nsvcd__quat_along(start, end, arc, u));
}

// s (a + t b).
static inline nsvcd__mat3 nsvcd__mat3_mix(float s, const nsvcd__mat3 *a, float t,
                                          const nsvcd__mat3 *b) {
  const nsvcd__mat3 out = {nsvcd__f3_scale(nsvcd__f3_fma(t, b->x, a->x), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->y, a->y), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->z, a->z), s)};
  return out;
}
#endif  // NSVCD__HAS_GROUND_ROTATIONS

// ---------------------------------------------------------------------------------- ground/motions
#ifndef NSVCD__HAS_GROUND_MOTIONS
#define NSVCD__HAS_GROUND_MOTIONS
// In: poses, as a caller gives them. Out: in double, where a body is between two of them, and how
// it turns on the way: its rotation is a slerp on the shorter arc, and the position of its pivot
// linear. With the pivot c of the body's frame, scaled, the pivot of a pose is at position + R c.
//
// This is the law of motion, for proofs, certificates and robots. The floor of motions has it again
// in float, 16 segments at a time: every query cuts its motion, and poses in double alone would
// take longer than that.

// A pose in double. Its rotation is of any length.
typedef struct nsvcd__dpose {
  nsvcd__dquat rotation;
  nsvcd__d3 position;
} nsvcd__dpose;

static inline nsvcd__dpose nsvcd__dpose_of(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dpose out = {{(double)q[0], (double)q[1], (double)q[2], (double)q[3]},
                            nsvcd__d3_load(pose->position)};
  return out;
}

// With a unit rotation.
static inline nsvcd__dpose nsvcd__unit_dpose(const nsvcd_pose *pose) {
  nsvcd__dpose out = nsvcd__dpose_of(pose);
  out.rotation = nsvcd__dquat_unit(out.rotation);
  return out;
}

static inline nsvcd__dtransform nsvcd__dtransform_of(const nsvcd__dpose *pose) {
  const nsvcd__dtransform out = {nsvcd__dmat3_of(nsvcd__dquat_unit(pose->rotation)),
                                 pose->position};
  return out;
}

static inline nsvcd_pose nsvcd__dpose_round(const nsvcd__dpose *pose) {
  const nsvcd__dquat turn = nsvcd__dquat_unit(pose->rotation);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__f3_round(pose->position), out.position);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__dquat_axis(turn)), out.rotation);
  out.rotation[3] = nsvcd__to_float(turn.w);
  return out;
}

// Is the shorter arc from a to b the one to -b?
static inline int nsvcd__poses_opposed(const nsvcd_pose *a, const nsvcd_pose *b) {
  return nsvcd__quats_opposed(nsvcd__quat_load(a->rotation), nsvcd__quat_load(b->rotation));
}

// The length of the arc from a to b, both unit, in quaternion space: half the angle of the turn.
static inline double nsvcd__dquat_arc(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__dquat difference = nsvcd__dquat_fma(-1, b, a);
  const nsvcd__dquat sum = nsvcd__dquat_fma(1, b, a);
  const double apart = sqrt(nsvcd__dquat_dot(difference, difference));
  return 2 * nsvcd__atan2(apart, sqrt(nsvcd__dquat_dot(sum, sum)));
}

// How a body turns from a pose to the next, or in a part of that time.
typedef struct nsvcd__slerp {
  // at the poses: unit, on the shorter side
  nsvcd__dquat start, end;
  double half_angle;  // between them as quaternions: half the angle of the turn
  // between the poses, 0 to 1: where the part begins, and its length
  double from, fraction;
} nsvcd__slerp;

// All of the turn from a to b.
static inline nsvcd__slerp nsvcd__slerp_of(const nsvcd_pose *a, const nsvcd_pose *b) {
  const double side = nsvcd__poses_opposed(a, b) ? -1 : 1;
  const nsvcd__dquat start = nsvcd__unit_dpose(a).rotation;
  const nsvcd__dquat end = nsvcd__unit_dpose(b).rotation;
  nsvcd__slerp out = {start, nsvcd__dquat_scale(end, side), 0, 0, 1};
  out.half_angle = nsvcd__dquat_arc(out.start, out.end);
  return out;
}

// The rotation at fraction u of the part, unit.
static inline nsvcd__dquat nsvcd__slerp_at(const nsvcd__slerp *s, double u) {
  const double along = s->from + s->fraction * u;
  return nsvcd__dquat_unit(nsvcd__dquat_along(s->start, s->end, s->half_angle, along));
}

// The rotation vector of the part. Points bend off their chords by an eighth of its square, per
// metre from its axis: a turn by h at a constant rate about a moves a point y with a second
// derivative of h^2 a x (a x y), by the fraction of the turn that has gone by. Along a direction n
// that is h^2 (n x a).(a x y).
static inline nsvcd__d3 nsvcd__slerp_turn(const nsvcd__slerp *slerp) {
  const nsvcd__d3 axis = nsvcd__dquat_turn(slerp->start, slerp->end);
  const double sine = nsvcd__d3_norm(axis);
  const double angle = 2 * slerp->half_angle * slerp->fraction;
  return nsvcd__d3_scale(axis, sine > 0 ? angle / sine : 0);
}

// From a pose's origin s times to its pivot c.
static inline nsvcd__d3 nsvcd__to_pivot(const nsvcd__dpose *pose, nsvcd__d3 c, double s) {
  if (!(nsvcd__d3_dot(c, c) > 0)) return pose->position;
  const nsvcd__dtransform at = nsvcd__dtransform_of(pose);
  return nsvcd__d3_transform(&at, nsvcd__d3_scale(c, s));
}

// The position of a pose's pivot c.
static inline nsvcd__d3 nsvcd__pivot_of(const nsvcd_pose *pose, nsvcd__d3 c) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  return nsvcd__to_pivot(&at, c, 1);
}

// The pose at fraction u between two, with the pivot c.
static inline nsvcd__dpose nsvcd__dpose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                nsvcd__d3 c, double u) {
  const nsvcd__slerp s = nsvcd__slerp_of(a, b);
  nsvcd__dpose out = {nsvcd__dquat_along(s.start, s.end, s.half_angle, u),
                      nsvcd__d3_mix(nsvcd__pivot_of(a, c), nsvcd__pivot_of(b, c), u)};
  out.position = nsvcd__to_pivot(&out, c, -1);
  return out;
}
#endif  // NSVCD__HAS_GROUND_MOTIONS

// ----------------------------------------------------------------------------------- ground/random
#ifndef NSVCD__HAS_GROUND_RANDOM
#define NSVCD__HAS_GROUND_RANDOM
// In: a state. Out: random numbers, the same from the same state.

// Splitmix64, in (0, 1].
static inline double nsvcd__random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) * 1.1102230246251565e-16 + 5.5e-17;
}
#endif  // NSVCD__HAS_GROUND_RANDOM

// ----------------------------------------------------------------------------------- ground/memory
#ifndef NSVCD__HAS_GROUND_MEMORY
#define NSVCD__HAS_GROUND_MEMORY
// In: the caller's allocator, or a workspace. Out: arrays from either.

#ifndef NSVCD_NO_ENCODER
static void *nsvcd__alloc(const nsvcd_allocator *allocator, size_t size) {
  return allocator ? allocator->alloc(size, allocator->user) : malloc(size);
}
static void nsvcd__free(const nsvcd_allocator *allocator, void *memory) {
  if (allocator && memory) allocator->free(memory, allocator->user);
  if (!allocator) free(memory);
}
// count * size bytes; NULL also if that overflows.
static void *nsvcd__alloc_array(const nsvcd_allocator *allocator, size_t count, size_t size) {
  return count > SIZE_MAX / size ? NULL : nsvcd__alloc(allocator, count * size);
}

// Arrays that are freed together. `failed` says that there was no memory for one of them: it is
// checked once, after the last.
typedef union nsvcd__header {
  union nsvcd__header *next;
  double aligned;
} nsvcd__header;
typedef struct nsvcd__arena {
  const nsvcd_allocator *allocator;
  nsvcd__header *last;  // an array follows each
  int failed;
} nsvcd__arena;

static nsvcd__arena nsvcd__arena_of(const nsvcd_allocator *allocator) {
  const nsvcd__arena out = {allocator, NULL, 0};
  return out;
}
static void nsvcd__arena_free(nsvcd__arena *arena) {
  while (arena->last) {
    nsvcd__header *header = arena->last;
    arena->last = header->next;
    nsvcd__free(arena->allocator, header);
  }
}

// Uninitialized memory for an array; NULL if there is none.
static void *nsvcd__arena_room(nsvcd__arena *arena, size_t count, size_t size) {
  nsvcd__header *header = NULL;
  if (count <= (SIZE_MAX - sizeof *header) / size)
    header = (nsvcd__header *)nsvcd__alloc(arena->allocator, sizeof *header + count * size);
  if (!header) {
    arena->failed = 1;
    return NULL;
  }
  header->next = arena->last;
  arena->last = header;
  return header + 1;
}

// An array of zeros; NULL without memory.
#define NSVCD__TAKE(arena, type, count) ((type *)nsvcd__arena_take(arena, count, sizeof(type)))
static void *nsvcd__arena_take(nsvcd__arena *arena, size_t count, size_t size) {
  void *array = nsvcd__arena_room(arena, count, size);
  return array ? memset(array, 0, count * size) : NULL;
}

// Memory in place of an array (NULL: none), whose first `used` bytes it keeps; without memory the
// array stays.
static void *nsvcd__arena_grow(nsvcd__arena *arena, void *old, size_t used, size_t count,
                               size_t size) {
  nsvcd__header **at = &arena->last;
  void *larger = nsvcd__arena_room(arena, count, size);
  if (!larger || !old) return larger;
  memcpy(larger, old, used);
  while ((void *)(*at + 1) != old) at = &(*at)->next;
  nsvcd__header *header = *at;
  *at = header->next;
  nsvcd__free(arena->allocator, header);
  return larger;
}
#endif

// The next array of a workspace, or, if base is NULL, only counts its bytes: in 64 bits, because a
// 32-bit machine may not be able to address them.
static void *nsvcd__take(char *base, uint64_t *used, size_t rows, size_t row_size) {
  void *at = base ? base + *used : NULL;
  const uint64_t bytes = (uint64_t)rows * row_size;
  *used += (bytes + NSVCD_ALIGNMENT - 1) / NSVCD_ALIGNMENT * NSVCD_ALIGNMENT;
  return at;
}
#define NSVCD__TAKE_ROWS(type, rows, base, used) \
  ((type *)nsvcd__take(base, used, rows, sizeof(type)))
#endif  // NSVCD__HAS_GROUND_MEMORY

// ============================================================ robot: is a motion of joints free?

// ------------------------------------------------------------------------------------- robot/chain
// In: a scene, and joint values. Out: a checker, and where links and parts are, in double. The
// floor, top to bottom:
//
//   chain            links, joints and frames: forward kinematics
//   mimics           joints that others drive
//   steps            what the joints do between two times
//   deviation        how far points of a part can be from an axis; how far a part leaves its sweep
//   checker          the checker of a scene
//   cones            does an axis stay within its cone? a configuration near by in which it does
//   samples          configurations of a motion, and boxes about the parts in them
//   local_queries    two parts, in the frame of one of them
//   check            is a motion of the joints free?
//   merge            motions on clocks of their own, as one
//   looks            does a motion seem free?
//   proofs           a certificate of a pair, as the joints move it
//   rrt              trees of configurations, and the nearest node
//   configurations   one configuration: proximities, the nearest free one; which pairs can meet
//   cholesky         linear equations
//   reach            configurations that have a tool at a target
//   spans            two parts, and how far the joints between them move a point
//   meetings         configurations in which two parts meet, and in which they do not
//   partings         does a plane part two parts in all of a box of values?
//   ranges           do two parts meet never, always or sometimes?
//   blends           from one state to another, within limits of speed and acceleration
//   smooth           a path, timed, then smooth
//   grow             where a tree grows, and edge by edge, in the cones
//   trees            two trees, from the start and the goals, until they meet
//   route            a start and goals: a path, shortened, as a motion that is proven
//
// All questions about bodies are asked by nsvcd_sweep, as any program asks them.

// steps of a check that are asked about together, at most
#define NSVCD__MOST_STEPS 256

// A joint, as the checker has it, and the link that it carries.
typedef struct nsvcd__link {
  // of the joint, in its parent link
  nsvcd__dpose origin;
  // unit, in the joint's frame
  nsvcd__d3 axis;
} nsvcd__link;

// Where the links are in a configuration, in the world.
typedef struct nsvcd__links {
  // of the links, the world first
  nsvcd__dpose frames[NSVCD_MAX_JOINTS + 1];
  // of the joints: unit
  nsvcd__d3 axes[NSVCD_MAX_JOINTS];
} nsvcd__links;

// A box along the world's axes, in double.
typedef struct nsvcd__bounds {
  nsvcd__d3 low, high;
} nsvcd__bounds;

// A part, as the checker has it.
typedef struct nsvcd__member {
  // in its link
  nsvcd__dpose frame;
  // a sphere about its triangles, in its link; and no point is farther from its origin
  nsvcd__d3 centre;
  double radius, extent;
  // metres: what it goes beyond its triangles; the error of its balls, and how many it has
  double round, ball_error;
  size_t balls;
  // a box about all of it, in its own axes, scaled
  nsvcd__d3 middle, half;
  // of all samples, or where it rests
  nsvcd__bounds bounds;
  // its first sample, if it moves
  size_t row;
  // metres, at most: how far it leaves the sweep between its samples; errors of frames in double
  double deviation, rounding;
  // moves, but is in none of the pairs that are asked about: not placed
  int is_skipped;
} nsvcd__member;

// A cone, as the checker has it.
typedef struct nsvcd__kept_axis {
  uint32_t link;
  // unit, in the link and in the world
  nsvcd__d3 axis, direction;
  double angle;
} nsvcd__kept_axis;

struct nsvcd_checker {
  // the caller's; or, where joints mimic others, that with joints of its own
  const nsvcd_scene *scene;
  nsvcd_scene own;
  // (F)
  nsvcd_joint *joints;
  nsvcd__link *links;
  // where the links are: in a configuration, or at both ends of a step
  nsvcd__links *at, *next;
  // (B)
  nsvcd__member *members;
  // the parts that move
  uint32_t *movers;
  size_t mover_count;
  // (C)
  nsvcd__kept_axis *cones;
  // (P): the pairs, as they are asked about: what was hit last first
  uint32_t *order;
  // (P): those of an interval that are not proven yet
  uint32_t *left;
  // (moving parts, NSVCD__MOST_STEPS + 1): samples, in the world; metres that a part deviates in
  // the step after each, at most
  nsvcd__dpose *frames;
  nsvcd__bounds *bounds;
  double *deviations;
  // (NSVCD__MOST_STEPS + 1): of both parts of a pair, see local_queries
  nsvcd_pose *local[2];
  // of the samples; and the most, in the step after each, that parts deviate which are near there
  double times[NSVCD__MOST_STEPS + 1], coarse[NSVCD__MOST_STEPS + 1];
  // (W, 2): when a motion leaves what is allowed at its start, and enters what is at its end
  double *cuts;
  void *query;
  size_t query_size;
  // questions are about surfaces alone
  int surfaces;
  // ends questions; NULL: nothing does
  int (*stop)(void *user);
  void *user;
  // an error of a question, which ends those that follow
  nsvcd_result result;
  // units that questions took so far
  uint64_t units;
};

static nsvcd__d3 nsvcd__dquat_rotate(nsvcd__dquat q, nsvcd__d3 a) {
  const nsvcd__d3 axis = nsvcd__dquat_axis(q);
  const nsvcd__d3 twice = nsvcd__d3_scale(nsvcd__d3_cross(axis, a), 2);
  return nsvcd__d3_add(nsvcd__d3_fma(q.w, twice, a), nsvcd__d3_cross(axis, twice));
}

static nsvcd__d3 nsvcd__dpose_apply(const nsvcd__dpose *frame, nsvcd__d3 a) {
  return nsvcd__d3_add(nsvcd__dquat_rotate(frame->rotation, a), frame->position);
}

static nsvcd__dpose nsvcd__dpose_mul(const nsvcd__dpose *a, const nsvcd__dpose *b) {
  const nsvcd__d3 position = nsvcd__dquat_rotate(a->rotation, b->position);
  const nsvcd__dpose out = {nsvcd__dquat_mul(a->rotation, b->rotation),
                            nsvcd__d3_add(a->position, position)};
  return out;
}

// b, as seen from a.
static nsvcd__dpose nsvcd__dpose_inverse_mul(const nsvcd__dpose *a, const nsvcd__dpose *b) {
  const nsvcd__dquat back = nsvcd__dquat_inverse(a->rotation);
  const nsvcd__d3 offset = nsvcd__d3_sub(b->position, a->position);
  const nsvcd__dpose out = {nsvcd__dquat_mul(back, b->rotation),
                            nsvcd__dquat_rotate(back, offset)};
  return out;
}

// The link before another one on the way to the world.
static size_t nsvcd__link_before(const nsvcd_checker *c, size_t link) {
  return c->scene->joints[link - 1].parent;
}

static int nsvcd__slides(const nsvcd_checker *c, size_t joint) {
  return c->scene->joints[joint].kind == NSVCD_JOINT_PRISMATIC;
}

// What a joint carries, in the joint's parent link.
static nsvcd__dpose nsvcd__joint_frame(const nsvcd_checker *c, size_t joint, double value) {
  const nsvcd__link *link = &c->links[joint];
  const int slides = nsvcd__slides(c, joint);
  const nsvcd__d3 axis = nsvcd__d3_scale(link->axis, slides ? value : sin(0.5 * value));
  const nsvcd__dpose slid = {{0, 0, 0, 1}, axis};
  const nsvcd__dpose turned = {{axis.x, axis.y, axis.z, cos(0.5 * value)}, {0, 0, 0}};
  return nsvcd__dpose_mul(&link->origin, slides ? &slid : &turned);
}

// Forward kinematics.
static void nsvcd__place_links(const nsvcd_checker *c, const double *joints,
                               nsvcd__links *out) {
  const nsvcd__dpose world = {{0, 0, 0, 1}, {0, 0, 0}};
  out->frames[0] = world;
  for (size_t i = 0; i < c->scene->joint_count; i++) {
    const nsvcd__dpose link = nsvcd__joint_frame(c, i, joints[i]);
    out->frames[i + 1] = nsvcd__dpose_mul(&out->frames[c->scene->joints[i].parent], &link);
    out->axes[i] = nsvcd__dquat_rotate(out->frames[i + 1].rotation, c->links[i].axis);
  }
}

static nsvcd__dpose nsvcd__frame_of_part(const nsvcd_checker *c, const nsvcd__links *at,
                                         size_t part) {
  const uint32_t link = c->scene->parts[part].link;
  return nsvcd__dpose_mul(&at->frames[link], &c->members[part].frame);
}

NSVCDDEF void nsvcd_forward_kinematics(const nsvcd_checker *checker, const double *joints,
                                       nsvcd_pose *poses) {
  nsvcd__links at;
  nsvcd__place_links(checker, joints, &at);
  for (size_t n = 0; n < checker->scene->part_count; n++) {
    const nsvcd__dpose frame = nsvcd__frame_of_part(checker, &at, n);
    poses[n] = nsvcd__dpose_round(&frame);
  }
}

// ------------------------------------------------------------------------------------ robot/mimics
// In: a scene. Out: which joints drive others, and configurations in which these follow.
//
// A joint that mimics has a value in each configuration, as all joints have, so all that is proven
// of a motion is proven of it as well. A line or a curve keeps the relation between its control
// points. Where values are drawn, clamped or turned, those that mimic are computed anew.

// of 1 and the numbers that its leader makes it of: by how much a joint's value may be another
#define NSVCD__MIMIC_ERROR 1e-9
// the least multiplier
#define NSVCD__LEAST_MULTIPLIER 1e-6

// The joint that drives one: its leader, or itself.
static size_t nsvcd__driver(const nsvcd_scene *scene, size_t joint) {
  const uint32_t mimic = scene->joints[joint].mimic;
  return mimic ? mimic - 1 : joint;
}

// How far a joint goes as its driver goes by 1.
static double nsvcd__rate(const nsvcd_scene *scene, size_t joint) {
  return scene->joints[joint].mimic ? scene->joints[joint].multiplier : 1;
}

// The value that a joint's driver gives it in a configuration.
static double nsvcd__driven(const nsvcd_scene *scene, size_t joint, const double *at) {
  const nsvcd_joint *j = &scene->joints[joint];
  return j->mimic ? j->multiplier * at[j->mimic - 1] + j->offset : at[joint];
}

// Does a joint drive others?
static int nsvcd__leads(const nsvcd_scene *scene, size_t joint) {
  for (size_t k = 0; k < scene->joint_count; k++)
    if (scene->joints[k].mimic == joint + 1) return 1;
  return 0;
}

// Puts the joints that mimic where their leaders have them, in so many configurations.
static void nsvcd__follow(const nsvcd_scene *scene, size_t count, double *rows) {
  for (double *at = rows; count > 0; count--, at += scene->joint_count)
    for (size_t j = 0; j < scene->joint_count; j++) at[j] = nsvcd__driven(scene, j, at);
}

// Are they there, but for rounding?
static int nsvcd__follows(const nsvcd_scene *scene, size_t count, const double *rows) {
  for (const double *at = rows; count > 0; count--, at += scene->joint_count) {
    for (size_t j = 0; j < scene->joint_count; j++) {
      if (!scene->joints[j].mimic) continue;
      const double value = nsvcd__driven(scene, j, at);
      const double offset = scene->joints[j].offset;
      const double most = 1 + fabs(offset) + fabs(value - offset);
      if (!(fabs(at[j] - value) <= NSVCD__MIMIC_ERROR * most)) return 0;
    }
  }
  return 1;
}

static double nsvcd__speed_of(const nsvcd_joint *joint) {
  return joint->speed > 0 ? joint->speed : 1;
}
static double nsvcd__acceleration_of(const nsvcd_joint *joint) {
  return joint->acceleration > 0 ? joint->acceleration : 1;
}

// A joint of a scene, with limits that those which mimic it keep theirs in.
static nsvcd_joint nsvcd__narrowed(const nsvcd_scene *scene, size_t joint) {
  nsvcd_joint out = scene->joints[joint];
  for (size_t k = 0; k < scene->joint_count; k++) {
    const nsvcd_joint *other = &scene->joints[k];
    if (other->mimic != joint + 1) continue;
    const double rate = fabs(other->multiplier);
    out.speed = nsvcd__min(nsvcd__speed_of(&out), nsvcd__speed_of(other) / rate);
    out.acceleration =
        nsvcd__min(nsvcd__acceleration_of(&out), nsvcd__acceleration_of(other) / rate);
    if (other->kind == NSVCD_JOINT_CONTINUOUS) continue;
    const double a = (other->low - other->offset) / other->multiplier;
    const double b = (other->high - other->offset) / other->multiplier;
    const int is_endless = out.kind == NSVCD_JOINT_CONTINUOUS;
    out.low = is_endless ? nsvcd__min(a, b) : nsvcd__max(out.low, nsvcd__min(a, b));
    out.high = is_endless ? nsvcd__max(a, b) : nsvcd__min(out.high, nsvcd__max(a, b));
    if (is_endless) out.kind = NSVCD_JOINT_REVOLUTE;
  }
  return out;
}

// ------------------------------------------------------------------------------------- robot/steps
// In: a motion of the joints, and two times. Out: what the joints do between them.

// A step of a motion: from one time to another, h later.
typedef struct nsvcd__step {
  // the joints at both
  double from[NSVCD_MAX_JOINTS], to[NSVCD_MAX_JOINTS];
  // |d|, d = to - from; max |q - from|
  double travel[NSVCD_MAX_JOINTS], farthest[NSVCD_MAX_JOINTS];
  // at least 8 |e|, see robot/deviation.h
  double bend[NSVCD_MAX_JOINTS];
} nsvcd__step;

// Squared: radians and metres alike.
static double nsvcd__distance2(const double *a, const double *b, size_t joints) {
  double sum = 0;
  for (size_t j = 0; j < joints; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

// A motion of no pieces is its first point, whatever else it says.
static nsvcd_joint_motion nsvcd__motion_meant(const nsvcd_joint_motion *motion) {
  const nsvcd_joint_motion still = {0, 0, motion->points, NULL};
  return motion->pieces ? *motion : still;
}

static double nsvcd__piece_start(const nsvcd_joint_motion *m, size_t piece) {
  return m->times ? m->times[piece] : (double)piece;
}

static double nsvcd__piece_time(const nsvcd_joint_motion *m, size_t piece) {
  return nsvcd__piece_start(m, piece + 1) - nsvcd__piece_start(m, piece);
}

// The piece that a time is in; where two pieces meet, the later one.
static size_t nsvcd__piece_at(const nsvcd_joint_motion *m, double time) {
  size_t low = 0;
  size_t high = m->pieces;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(nsvcd__piece_start(m, middle) <= time ? &low : &high) = middle;
  }
  return low;
}

// How much of a piece has gone by at a time: in [0,1].
static double nsvcd__fraction_at(const nsvcd_joint_motion *m, size_t piece, double time) {
  const double start = nsvcd__piece_start(m, piece);
  if (time >= nsvcd__piece_start(m, piece + 1)) return 1;
  return time > start ? (time - start) / nsvcd__piece_time(m, piece) : 0;
}

// The control points of one joint in a piece.
static void nsvcd__joint_points(const nsvcd_joint_motion *m, size_t piece, size_t joints,
                                size_t joint, double *p) {
  const double *first = m->points + piece * m->degree * joints + joint;
  for (size_t i = 0; i <= m->degree; i++) p[i] = first[i * joints];
}

// Cuts a curve to its fractions from s0 to s1: de Casteljau's algorithm, twice.
static void nsvcd__cut_curve(double *p, size_t degree, double s0, double s1) {
  const double before = s1 > 0 ? s0 / s1 : 0;
  // the first s1 of it: p[i] becomes the point of level i
  for (size_t level = 1; level <= degree && s1 < 1; level++) {
    for (size_t i = degree; i >= level; i--) p[i] = p[i - 1] + s1 * (p[i] - p[i - 1]);
  }
  // of that, what is after s0
  for (size_t level = 1; level <= degree && before > 0; level++) {
    for (size_t i = 0; i + level <= degree; i++) p[i] = p[i] + before * (p[i + 1] - p[i]);
  }
}

// The joints at a fraction of a piece, and, unless NULL, their speeds.
static void nsvcd__joints_at(const nsvcd_joint_motion *m, size_t joints, size_t piece,
                             double fraction, double *at, double *speeds) {
  const size_t degree = m->degree;
  for (size_t j = 0; j < joints; j++) {
    double p[NSVCD_MAX_DEGREE + 1];
    nsvcd__joint_points(m, piece, joints, j, p);
    for (size_t level = degree; level > 0; level--) {
      if (level == 1 && speeds)
        speeds[j] = (double)degree * (p[1] - p[0]) / nsvcd__piece_time(m, piece);
      // both ends exactly
      for (size_t i = 0; i < level; i++)
        p[i] = fraction < 1 ? p[i] + fraction * (p[i + 1] - p[i]) : p[i + 1];
    }
    at[j] = p[0];
  }
}

// The same at a time.
static void nsvcd__joints_at_time(const nsvcd_joint_motion *m, size_t joints, double time,
                                  double *at, double *speeds) {
  const size_t piece = nsvcd__piece_at(m, time);
  const double fraction = nsvcd__fraction_at(m, piece, time);
  nsvcd__joints_at(m, joints, piece, fraction, at, speeds);
}

NSVCDDEF void nsvcd_motion_at(const nsvcd_joint_motion *motion, size_t joints, double time,
                              double *out) {
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  nsvcd__joints_at_time(&m, joints, time, out, NULL);
}

// By how much the speed of a joint jumps where a piece begins.
static double nsvcd__jump_at(const nsvcd_joint_motion *m, size_t joints, size_t piece,
                             size_t joint) {
  const double *at = m->points + piece * m->degree * joints + joint;
  const double before = (at[0] - *(at - joints)) / nsvcd__piece_time(m, piece - 1);
  const double after = (at[joints] - at[0]) / nsvcd__piece_time(m, piece);
  return fabs((double)m->degree * (after - before));
}

// What the joints do from time t0 to t1, which may span several pieces. Where the speed jumps by v,
// e has a corner, and |e| grows by h v / 4 at most.
static void nsvcd__step_of(const nsvcd_joint_motion *m, size_t joints, double t0, double t1,
                           nsvcd__step *step) {
  const size_t degree = m->degree;
  const double twice = (double)(degree * (degree - 1));
  const size_t first = nsvcd__piece_at(m, t0);
  size_t last = first;
  double v0[NSVCD_MAX_JOINTS], v1[NSVCD_MAX_JOINTS];
  double along = 0;
  double square = 0;
  const double h = t1 - t0;
  while (last + 1 < m->pieces && nsvcd__piece_start(m, last + 1) < t1) last++;
  const double begin = nsvcd__fraction_at(m, first, t0);
  const double end = nsvcd__fraction_at(m, last, t1);
  nsvcd__joints_at(m, joints, first, begin, step->from, v0);
  nsvcd__joints_at(m, joints, last, end, step->to, v1);
  for (size_t j = 0; j < joints; j++) {
    const double d = step->to[j] - step->from[j];
    step->travel[j] = step->farthest[j] = fabs(d);
    step->bend[j] = 0;
    if (degree > 1) along += d * h * (v1[j] - v0[j]);
    square += d * d;
  }
  if (degree == 1 && first == last) return;
  // what suits the mean of the second derivatives
  const double g = square > 0 ? nsvcd__max(-2, nsvcd__min(2, along / square)) : 0;
  for (size_t j = 0; j < joints; j++) {
    const double from = step->from[j];
    const double d = step->to[j] - from;
    double jumps = 0;
    for (size_t piece = first; piece <= last; piece++) {
      double p[NSVCD_MAX_DEGREE + 1], second[NSVCD_MAX_DEGREE + 1];
      const double s0 = piece == first ? begin : 0;
      const double s1 = piece == last ? end : 1;
      const double per_piece = h / nsvcd__piece_time(m, piece);
      nsvcd__joint_points(m, piece, joints, j, p);
      for (size_t i = 0; i + 2 <= degree; i++)
        second[i] = per_piece * per_piece * twice * (p[i] - 2 * p[i + 1] + p[i + 2]);
      if (degree >= 2) nsvcd__cut_curve(second, degree - 2, s0, s1);
      nsvcd__cut_curve(p, degree, s0, s1);
      for (size_t i = 0; i <= degree; i++)
        step->farthest[j] = nsvcd__max(step->farthest[j], fabs(p[i] - from));
      for (size_t i = 0; i + 2 <= degree; i++)
        step->bend[j] = nsvcd__max(step->bend[j], fabs(second[i] - g * d));
      if (piece > first) jumps += nsvcd__jump_at(m, joints, piece, j);
    }
    step->bend[j] += 2 * h * jumps;
  }
}

// -------------------------------------------------------------------------------- robot/allowances
// In: a motion, and contact that a scene allows near some configurations. Out: when a pair is
// allowed to touch.
//
// Each joint's values over a time are bounded by their control points, and from these how far the
// parts are from where they are in the configuration.

// by how much less than an allowance's distance is sought when a motion leaves it, for rounding
#define NSVCD__ALLOWANCE_ROUNDING 1e-9
#define NSVCD__ALLOWANCE_HALVINGS 40

// The last link that carries two others.
static size_t nsvcd__common_link(const nsvcd_scene *scene, size_t a, size_t b) {
  while (a != b) {
    size_t *later = a > b ? &a : &b;
    *later = scene->joints[*later - 1].parent;
  }
  return a;
}

// Are both parts of an allowance's pair within its distance, and `more` metres, of where they are
// in its configuration, for all joint values from `low` to `high`?
static int nsvcd__allows(const nsvcd_checker *c, const nsvcd_allowance *allowance,
                         const double *low, const double *high, double more) {
  const double full_turn = 6.283185307179586;
  const nsvcd_body_pair *pair = &c->scene->pairs[allowance->pair];
  const size_t parts[2] = {pair->a, pair->b};
  const size_t base = nsvcd__common_link(c->scene, c->scene->parts[pair->a].link,
                                         c->scene->parts[pair->b].link);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__member *m = &c->members[parts[n]];
    double reach = nsvcd__d3_norm(m->frame.position) + m->extent + m->round;
    double moved = 0;
    for (size_t link = c->scene->parts[parts[n]].link; link != base;
         link = nsvcd__link_before(c, link)) {
      const size_t j = link - 1;
      const int is_endless = c->scene->joints[j].kind == NSVCD_JOINT_CONTINUOUS;
      const double off = 0.5 * (low[j] + high[j]) - allowance->joints[j];
      const double turns = is_endless ? floor(off / full_turn + 0.5) : 0;
      const double at = allowance->joints[j] + full_turn * turns;
      const double most = nsvcd__max(fabs(at), nsvcd__max(fabs(low[j]), fabs(high[j])));
      const double way = nsvcd__max(fabs(low[j] - at), fabs(high[j] - at));
      moved += nsvcd__slides(c, j) ? way : way * reach;
      reach += nsvcd__d3_norm(c->links[j].origin.position);
      if (nsvcd__slides(c, j)) reach += most;
    }
    if (!(moved <= allowance->distance + more)) return 0;
  }
  return 1;
}

// Bounds of the joints' values from time t0 to t1.
static void nsvcd__joint_ranges(const nsvcd_joint_motion *m, size_t joints, double t0,
                                double t1, double *low, double *high) {
  const size_t first = nsvcd__piece_at(m, t0);
  for (size_t j = 0; j < joints; j++) {
    low[j] = HUGE_VAL;
    high[j] = -HUGE_VAL;
    for (size_t piece = first;; piece++) {
      double p[NSVCD_MAX_DEGREE + 1];
      nsvcd__joint_points(m, piece, joints, j, p);
      if (m->degree > 0)
        nsvcd__cut_curve(p, m->degree, nsvcd__fraction_at(m, piece, t0),
                         nsvcd__fraction_at(m, piece, t1));
      for (size_t i = 0; i <= m->degree; i++) {
        low[j] = nsvcd__min(low[j], p[i]);
        high[j] = nsvcd__max(high[j], p[i]);
      }
      if (piece + 1 >= m->pieces || !(nsvcd__piece_start(m, piece + 1) < t1)) break;
    }
  }
}

// Is contact allowed all the while from time t0 to t1?
static int nsvcd__allows_from_to(const nsvcd_checker *c, const nsvcd_allowance *allowance,
                                 const nsvcd_joint_motion *m, double t0, double t1,
                                 double more) {
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  nsvcd__joint_ranges(m, c->scene->joint_count, t0, t1, low, high);
  return nsvcd__allows(c, allowance, low, high, more);
}

static int nsvcd__pair_is_allowed(const nsvcd_checker *c, size_t pair,
                                  const nsvcd_joint_motion *m, double t0, double t1) {
  for (size_t n = 0; n < c->scene->allowance_count; n++) {
    const nsvcd_allowance *allowance = &c->scene->allowances[n];
    if (allowance->pair == pair && nsvcd__allows_from_to(c, allowance, m, t0, t1, 0)) return 1;
  }
  return 0;
}

// Until when contact is allowed from one end of a motion on. Returns that end where it is not.
static double nsvcd__allowed_up_to(const nsvcd_checker *c, const nsvcd_allowance *allowance,
                                   const nsvcd_joint_motion *m, double end, double other) {
  const double less = -NSVCD__ALLOWANCE_ROUNDING * allowance->distance;
  double allowed = end;
  double not_allowed = other;
  if (!nsvcd__allows_from_to(c, allowance, m, end, end, less)) return end;
  for (size_t n = 0; n < NSVCD__ALLOWANCE_HALVINGS; n++) {
    const double t = n ? 0.5 * (allowed + not_allowed) : other;
    const int is_allowed =
        nsvcd__allows_from_to(c, allowance, m, nsvcd__min(end, t), nsvcd__max(end, t), less);
    *(is_allowed ? &allowed : &not_allowed) = t;
    if (is_allowed && n == 0) break;
  }
  return allowed;
}

// Notes when a motion leaves what is allowed at its start, and enters what is allowed at its end.
static void nsvcd__note_cuts(nsvcd_checker *c, const nsvcd_joint_motion *m) {
  const double t0 = nsvcd__piece_start(m, 0);
  const double t1 = nsvcd__piece_start(m, m->pieces);
  for (size_t n = 0; n < c->scene->allowance_count; n++) {
    c->cuts[2 * n] = nsvcd__allowed_up_to(c, &c->scene->allowances[n], m, t0, t1);
    c->cuts[2 * n + 1] = nsvcd__allowed_up_to(c, &c->scene->allowances[n], m, t1, t0);
  }
}

// The first of these times after one, or `end`.
static double nsvcd__next_cut(const nsvcd_checker *c, double time, double end) {
  double next = end;
  for (size_t n = 0; n < 2 * c->scene->allowance_count; n++) {
    if (c->cuts[n] > time && c->cuts[n] < next) next = c->cuts[n];
  }
  return next;
}

// --------------------------------------------------------------------------------- robot/deviation
// In: a part, and a step of the joints between two samples. Out: by how much it leaves, at most,
// the line and the slerp between them.
//
// THE BOUND. A step goes from joints q0 to q1 = q0 + d in a time h; x in [0,1] is the fraction of
// it that has gone by. Let u = x - g x (1 - x) / 2 for a number |g| <= 2 of our choice: u goes from
// 0 to 1 too, and never back. Each joint is q0 + u d + e, with e = 0 at both ends and e'' = h^2 q''
// - g d, derivatives by x. So |e| <= max |e''| / 8; where q' jumps by v, e' jumps by h v, and |e|
// may be more by h v / 4. From where q0 + u d has it, a point y of the part is off by at most
//   sum over joints j of |e_j| r_j           r_j: no point is farther from the axis of j
// On the straight line q0 + u d the point leaves its chord by max |y''| / 8 at most, derivatives by
// u. While both turn, d^2 y / dq_j dq_k is no more than r of the outer one of j and k. For an outer
// one that slides r is 1; where the inner one slides, the derivative is 0. So
//   |y''| <= sum_j |d_j| r_j (2 sum over inner k that turn of |d_k| + |d_j|)
// and a joint that slides has no square. The sweep has the same poses at both ends, and between
// them a line of the origin and a slerp by an angle w: it leaves that chord by w^2 R / 8, R the
// point's distance from the origin. All together, for any u, and so at all times:
//   deviation <= (sum_j max |e''_j| r_j + |y''| + w^2 R) / 8
// r_j is that of the sample q0, and what the joints beyond j can add while they move.
// Source: this library.

// The angle of the turn from a to b, radians: the shorter one.
static double nsvcd__angle_between(nsvcd__dquat a, nsvcd__dquat b) {
  const double side = nsvcd__dquat_dot(a, b) < 0 ? -1 : 1;
  return 2 * nsvcd__dquat_arc(a, nsvcd__dquat_scale(b, side));
}

// r of the banner, (F): how far points of a part can be from the axes of the joints of its chain,
// during a step that begins in a configuration.
static void nsvcd__moment_arms_of(const nsvcd_checker *c, size_t part, const nsvcd__step *step,
                                  const nsvcd__links *from, double *arms) {
  const nsvcd__member *m = &c->members[part];
  size_t link = c->scene->parts[part].link;
  const nsvcd__d3 centre = nsvcd__dpose_apply(&from->frames[link], m->centre);
  // by joints beyond this one
  double moved = 0;
  for (; link > 0; link = nsvcd__link_before(c, link)) {
    const size_t j = link - 1;
    arms[j] = 1;
    if (!nsvcd__slides(c, j)) {
      const nsvcd__d3 off = nsvcd__d3_sub(centre, from->frames[j + 1].position);
      const nsvcd__d3 across = nsvcd__d3_cross(from->axes[j], off);
      arms[j] = nsvcd__d3_norm(across) + m->radius + moved;
    }
    moved += step->farthest[j] * arms[j];
  }
}

// The bound of the banner, for a part that moves.
static double nsvcd__part_deviation(const nsvcd_checker *c, size_t part,
                                    const nsvcd__step *step, const nsvcd__links *from,
                                    const nsvcd__links *to) {
  const size_t link = c->scene->parts[part].link;
  const double w =
      nsvcd__angle_between(from->frames[link].rotation, to->frames[link].rotation);
  double arms[NSVCD_MAX_JOINTS];
  double bend = 0;
  double second = 0;
  // from the part to the world; the sum over inner joints, as one over outer ones
  double outer = 0;
  nsvcd__moment_arms_of(c, part, step, from, arms);
  for (size_t at = link; at > 0; at = nsvcd__link_before(c, at)) {
    const size_t j = at - 1;
    const double moved = step->travel[j] * arms[j];
    bend += step->bend[j] * arms[j];
    if (!nsvcd__slides(c, j)) second += step->travel[j] * (2 * outer + moved);
    outer += moved;
  }
  return (bend + second + w * w * c->members[part].extent) / 8;
}

// ----------------------------------------------------------------------------------- robot/checker
// In: a scene. Out: its checker, in the caller's memory; or what is wrong with it.

// ---- is a scene in order?

// Finite, and no larger than a coordinate may be? By their bits, so that it holds under -ffast-math
// too: those of numbers that are not negative are in the order of the numbers.
static int nsvcd__are_numbers(const double *x, size_t count) {
  const double most = (double)NSVCD_MAX_COORDINATE;
  uint64_t bits, limit;
  memcpy(&limit, &most, sizeof limit);
  for (size_t i = 0; i < count; i++) {
    memcpy(&bits, &x[i], sizeof bits);
    if ((bits & ~(uint64_t)0 >> 1) > limit) return 0;
  }
  return 1;
}

// Is a direction finite, and of some length?
static int nsvcd__is_direction(const float *x) {
  double most = 0;
  for (size_t k = 0; k < 3; k++) most = nsvcd__max(most, fabs((double)x[k]));
  return nsvcd__in_range(x, 3, 1e15f) && most > 1e-15;
}

static nsvcd_result nsvcd__joint_check(const nsvcd_joint *joint, size_t i) {
  if (joint->parent > i || (unsigned)joint->kind > NSVCD_JOINT_PRISMATIC)
    return NSVCD_ERROR_JOINT;
  if (!nsvcd__is_direction(joint->axis)) return NSVCD_ERROR_AXIS;
  const nsvcd_result result = nsvcd__poses_check(&joint->origin, 1);
  if (result) return result;
  const double rates[2] = {joint->speed, joint->acceleration};
  if (!nsvcd__are_numbers(rates, 2) || rates[0] < 0 || rates[1] < 0) return NSVCD_ERROR_SPEED;
  const double limits[2] = {joint->low, joint->high};
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return NSVCD_OK;
  const int fits = nsvcd__are_numbers(limits, 2) && limits[0] <= limits[1];
  return fits ? NSVCD_OK : NSVCD_ERROR_LIMITS;
}

// Is a joint that mimics another in order? A full turn of a leader without limits has to bring back
// what follows it.
static nsvcd_result nsvcd__mimic_check(const nsvcd_scene *scene, const nsvcd_joint *joint) {
  const double numbers[2] = {joint->multiplier, joint->offset};
  if (!joint->mimic) return NSVCD_OK;
  if (joint->mimic > scene->joint_count || !nsvcd__are_numbers(numbers, 2))
    return NSVCD_ERROR_MIMIC;
  const nsvcd_joint *leader = &scene->joints[joint->mimic - 1];
  const double rate = fabs(joint->multiplier);
  const int is_endless =
      joint->kind == NSVCD_JOINT_CONTINUOUS && leader->kind == NSVCD_JOINT_CONTINUOUS;
  // so it is not itself either
  if (leader->mimic || !(rate >= NSVCD__LEAST_MULTIPLIER)) return NSVCD_ERROR_MIMIC;
  return is_endless && rate > floor(rate) ? NSVCD_ERROR_MIMIC : NSVCD_OK;
}

static nsvcd_result nsvcd__allowance_check(const nsvcd_scene *scene,
                                           const nsvcd_allowance *allowance) {
  if (allowance->pair >= scene->pair_count) return NSVCD_ERROR_PAIR;
  if (!allowance->joints) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__are_numbers(allowance->joints, scene->joint_count)) return NSVCD_ERROR_VALUE;
  if (!nsvcd__are_numbers(&allowance->distance, 1) || allowance->distance < 0)
    return NSVCD_ERROR_DISTANCE;
  return NSVCD_OK;
}

static nsvcd_result nsvcd__part_check(const nsvcd_scene *scene, const nsvcd_part *part) {
  const nsvcd_body *body = NULL;
  const nsvcd_result result = nsvcd_body_trust(part->body, SIZE_MAX, &body);
  if (result) return result;
  if (part->link > scene->joint_count) return NSVCD_ERROR_LINK;
  if (!nsvcd_body_describe(body).triangles) return NSVCD_ERROR_TRIANGLES;
  const float scale = part->scale;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE;
  if (!(fits || (scale <= 0 && scale >= 0))) return NSVCD_ERROR_SCALE;
  return nsvcd__poses_check(&part->pose, 1);
}

// Are the allowances and the cones of a scene in order, of which all else is?
static nsvcd_result nsvcd__extras_check(const nsvcd_scene *scene) {
  if (scene->allowance_count > 0 && !scene->allowances) return NSVCD_ERROR_ARGUMENT;
  for (size_t n = 0; n < scene->allowance_count; n++) {
    const nsvcd_result result = nsvcd__allowance_check(scene, &scene->allowances[n]);
    if (result) return result;
  }
  if (scene->cone_count > 0 && !scene->cones) return NSVCD_ERROR_ARGUMENT;
  for (size_t n = 0; n < scene->cone_count; n++) {
    const nsvcd_cone *cone = &scene->cones[n];
    if (cone->part >= scene->part_count) return NSVCD_ERROR_LINK;
    if (!nsvcd__is_direction(cone->axis) || !nsvcd__is_direction(cone->direction))
      return NSVCD_ERROR_AXIS;
    if (!nsvcd__are_numbers(&cone->angle, 1) ||
        !(cone->angle > 0 && cone->angle < 3.141592653589793))
      return NSVCD_ERROR_CONE;
  }
  return NSVCD_OK;
}

static nsvcd_result nsvcd__scene_check(const nsvcd_scene *scene) {
  nsvcd_result result = NSVCD_OK;
  if (!scene) return NSVCD_ERROR_ARGUMENT;
  const size_t parts = scene->part_count;
  if (scene->joint_count < 1 || scene->joint_count > NSVCD_MAX_JOINTS ||
      parts > NSVCD_MAX_PARTS)
    return NSVCD_ERROR_COUNT;
  if (!scene->joints || (parts > 0 && !scene->parts) ||
      (scene->pair_count > 0 && !scene->pairs))
    return NSVCD_ERROR_ARGUMENT;
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__joint_check(&scene->joints[i], i);
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__mimic_check(scene, &scene->joints[i]);
  for (size_t i = 0; i < scene->joint_count && !result; i++) {
    const nsvcd_joint joint = nsvcd__narrowed(scene, i);
    result = nsvcd__joint_check(&joint, i);
  }
  for (size_t n = 0; n < parts && !result; n++)
    result = nsvcd__part_check(scene, &scene->parts[n]);
  for (size_t k = 0; k < scene->pair_count && !result; k++) {
    const nsvcd_body_pair *pair = &scene->pairs[k];
    if (pair->a >= parts || pair->b >= parts ||
        scene->parts[pair->a].link == scene->parts[pair->b].link)
      return NSVCD_ERROR_PAIR;
    if (scene->clearances && !nsvcd__is_length(scene->clearances[k]))
      return NSVCD_ERROR_CLEARANCE;
  }
  return result ? result : nsvcd__extras_check(scene);
}

// ---- boxes

// Of a part whose frame in the world this is.
static nsvcd__bounds nsvcd__bounds_of(const nsvcd__member *m, const nsvcd__dpose *frame) {
  const nsvcd__dmat3 axes = nsvcd__dmat3_of(frame->rotation);
  const nsvcd__d3 *rows[3] = {&axes.x, &axes.y, &axes.z};
  nsvcd__d3 half = {0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 row = {fabs(rows[k]->x), fabs(rows[k]->y), fabs(rows[k]->z)};
    nsvcd__d3_set_axis(&half, k, nsvcd__d3_dot(row, m->half));
  }
  const nsvcd__d3 middle =
      nsvcd__d3_add(nsvcd__dmat3_apply(&axes, m->middle), frame->position);
  const nsvcd__bounds out = {nsvcd__d3_sub(middle, half), nsvcd__d3_add(middle, half)};
  return out;
}

static nsvcd__bounds nsvcd__bounds_over(const nsvcd__bounds *a, const nsvcd__bounds *b) {
  nsvcd__bounds out;
  out.low = nsvcd__d3_min(a->low, b->low);
  out.high = nsvcd__d3_max(a->high, b->high);
  return out;
}

// Are two boxes more than `room` apart along an axis?
static int nsvcd__bounds_apart(const nsvcd__bounds *a, const nsvcd__bounds *b, double room) {
  const nsvcd__d3 before = nsvcd__d3_sub(b->low, a->high);
  const nsvcd__d3 after = nsvcd__d3_sub(a->low, b->high);
  const nsvcd__d3 apart = nsvcd__d3_max(before, after);
  return apart.x > room || apart.y > room || apart.z > room;
}

// ---- a checker

// Lays a checker out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes; 0 if they are more than can be counted.
static size_t nsvcd__checker_layout(const nsvcd_scene *scene, char *base,
                                    nsvcd_checker **checker) {
  nsvcd_checker counted;
  uint64_t used = 0;
  size_t movers = 0;
  for (size_t n = 0; n < scene->part_count; n++) movers += scene->parts[n].link > 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd_checker));
  nsvcd_checker *c = at ? (nsvcd_checker *)at : &counted;
  const size_t parts = scene->part_count;
  const size_t pairs = scene->pair_count;
  const size_t samples = NSVCD__MOST_STEPS + 1;
  const size_t rows = movers * samples;
  c->joints = NSVCD__TAKE_ROWS(nsvcd_joint, scene->joint_count, base, &used);
  c->links = NSVCD__TAKE_ROWS(nsvcd__link, scene->joint_count, base, &used);
  c->at = NSVCD__TAKE_ROWS(nsvcd__links, 1, base, &used);
  c->next = NSVCD__TAKE_ROWS(nsvcd__links, 1, base, &used);
  c->members = NSVCD__TAKE_ROWS(nsvcd__member, parts, base, &used);
  c->movers = NSVCD__TAKE_ROWS(uint32_t, movers, base, &used);
  c->cones = NSVCD__TAKE_ROWS(nsvcd__kept_axis, scene->cone_count, base, &used);
  c->order = NSVCD__TAKE_ROWS(uint32_t, pairs, base, &used);
  c->left = NSVCD__TAKE_ROWS(uint32_t, pairs, base, &used);
  c->frames = NSVCD__TAKE_ROWS(nsvcd__dpose, rows, base, &used);
  c->bounds = NSVCD__TAKE_ROWS(nsvcd__bounds, rows, base, &used);
  c->deviations = NSVCD__TAKE_ROWS(double, rows, base, &used);
  for (size_t n = 0; n < 2; n++)
    c->local[n] = NSVCD__TAKE_ROWS(nsvcd_pose, samples, base, &used);
  c->cuts = NSVCD__TAKE_ROWS(double, 2 * scene->allowance_count, base, &used);
  c->query_size = nsvcd_sweep_workspace_size(NULL);
  c->query = nsvcd__take(base, &used, 1, c->query_size);
  *checker = (nsvcd_checker *)at;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene) {
  nsvcd_checker *unused;
  return nsvcd__scene_check(scene) ? 0 : nsvcd__checker_layout(scene, NULL, &unused);
}

static nsvcd__member nsvcd__member_of(const nsvcd_part *part) {
  const double scale = part->scale > 0 ? (double)part->scale : 1;
  const nsvcd_body_facts facts = nsvcd_body_describe(part->body);
  const nsvcd__d3 low = nsvcd__d3_load(facts.low);
  const nsvcd__d3 high = nsvcd__d3_load(facts.high);
  const nsvcd__d3 ones = {1, 1, 1};
  const nsvcd__d3 centre = nsvcd__d3_scale(nsvcd__d3_load(facts.centre), scale);
  const nsvcd__d3 half = nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5 * scale);
  nsvcd__member m;
  memset(&m, 0, sizeof m);
  m.frame = nsvcd__unit_dpose(&part->pose);
  m.centre = nsvcd__dpose_apply(&m.frame, centre);
  // spheres are computed in float
  m.radius = scale * (1.000001 * (double)facts.radius - (double)facts.convex_radius);
  m.extent = 1.000001 * scale * (double)facts.extent;
  m.middle = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5 * scale);
  // a rounded body goes beyond its triangles
  m.round = scale * (double)facts.convex_radius;
  m.half = nsvcd__d3_fma(m.round, ones, half);
  m.ball_error = scale * (double)facts.ball_error;
  m.balls = facts.balls;
  m.bounds = nsvcd__bounds_of(&m, &m.frame);
  return m;
}

NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker) {
  nsvcd_checker *c;
  const nsvcd_result result = nsvcd__scene_check(scene);
  if (result) return result;
  if (!checker) return NSVCD_ERROR_ARGUMENT;
  if (!memory || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  const size_t needed = nsvcd__checker_layout(scene, NULL, &c);
  if (!needed || size < needed) return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__checker_layout(scene, (char *)memory, &c);
  c->own = *scene;
  c->own.joints = c->joints;
  c->scene = scene;
  c->surfaces = 0;
  c->units = 0;
  c->stop = NULL;
  c->result = NSVCD_OK;
  for (size_t i = 0; i < scene->joint_count; i++) {
    const nsvcd_joint *joint = &scene->joints[i];
    c->joints[i] = nsvcd__narrowed(scene, i);
    if (joint->mimic) c->scene = &c->own;
    nsvcd__link *link = &c->links[i];
    link->origin = nsvcd__unit_dpose(&joint->origin);
    link->axis = nsvcd__d3_unit(nsvcd__d3_load(joint->axis), nsvcd__d3_of(0, 0, 1));
  }
  c->mover_count = 0;
  for (size_t n = 0; n < scene->part_count; n++) {
    c->members[n] = nsvcd__member_of(&scene->parts[n]);
    c->members[n].row = c->mover_count * (NSVCD__MOST_STEPS + 1);
    if (scene->parts[n].link) c->movers[c->mover_count++] = (uint32_t)n;
  }
  for (size_t n = 0; n < scene->cone_count; n++) {
    const nsvcd_cone *cone = &scene->cones[n];
    const nsvcd__d3 up = nsvcd__d3_of(0, 0, 1);
    const nsvcd__d3 axis = nsvcd__d3_unit(nsvcd__d3_load(cone->axis), up);
    c->cones[n].link = scene->parts[cone->part].link;
    c->cones[n].axis = nsvcd__dquat_rotate(c->members[cone->part].frame.rotation, axis);
    c->cones[n].direction = nsvcd__d3_unit(nsvcd__d3_load(cone->direction), up);
    c->cones[n].angle = cone->angle;
  }
  for (size_t k = 0; k < scene->pair_count; k++) c->order[k] = (uint32_t)k;
  *checker = c;
  return NSVCD_OK;
}

// ------------------------------------------------------------------------------------- robot/cones
// In: a scene's cones, and a motion, or a configuration. Out: does each axis stay in its cone? A
// configuration near by in which all do.
//
// THE BOUND. An axis is off a direction by no more than an angle where its product with it is no
// less than the angle's cosine: in a half space. In a step of the joints, if both its ends are in
// the half space, so is the chord between them, and how far it leaves that chord is what
// robot/deviation.h says of a point of which r_j is 1 for joints that turn, 0 for those that slide:
//   (sum_j max |e''_j| + (sum_j |d_j|)^2) / 8

// of the product of two directions: rounding, of 32 joints and in proportion if there are more; by
// radian that a joint has turned; and what a step is not cut further for, unless the product
// changes in it by more than a share of that, and by more than noise
#define NSVCD__CONE_ROUNDING 1e-13
#define NSVCD__CONE_TURNED 1e-15
#define NSVCD__CONE_FINEST 1e-10
#define NSVCD__CONE_CHANGE 1e-3
#define NSVCD__CONE_NOISE 1e-15
// steps between two questions whether to stop
#define NSVCD__CONE_POLL 64
// steps of a projection; by how much farther each goes, in all, and in proportion; and the least
// square of a slope that leads anywhere
#define NSVCD__CONE_STEPS 20
#define NSVCD__CONE_BEYOND 1e-6
#define NSVCD__CONE_FARTHER 1.01
#define NSVCD__CONE_SLOPE 1e-6

// ---- motions

// By how much the product of an axis with its direction is above the cosine of its cone's angle; if
// it is between -*error and *error, that is not known.
static double nsvcd__cone_margin(const nsvcd_checker *c, const nsvcd__kept_axis *cone,
                                 const double *q, double *error) {
  nsvcd__d3 axis = cone->axis;
  *error = NSVCD__CONE_ROUNDING * nsvcd__max(1, (double)c->scene->joint_count / 32);
  for (size_t link = cone->link; link > 0; link = nsvcd__link_before(c, link)) {
    const nsvcd__dpose frame = nsvcd__joint_frame(c, link - 1, q[link - 1]);
    axis = nsvcd__dquat_rotate(frame.rotation, axis);
    if (!nsvcd__slides(c, link - 1)) *error += NSVCD__CONE_TURNED * fabs(q[link - 1]);
  }
  return nsvcd__d3_dot(axis, cone->direction) - cos(cone->angle);
}

// The bound of the banner.
static double nsvcd__axis_deviation(const nsvcd_checker *c, const nsvcd__kept_axis *cone,
                                    const nsvcd__step *step) {
  double bend = 0;
  double turned = 0;
  for (size_t link = cone->link; link > 0; link = nsvcd__link_before(c, link)) {
    if (nsvcd__slides(c, link - 1)) continue;
    bend += step->bend[link - 1];
    turned += step->travel[link - 1];
  }
  return (bend + turned * turned) / 8 * (1 + 1e-9);
}

// Does an axis stay in its cone from time t0 to t1, of which the steps are as long as can be?
// Returns FREE; HIT at *at, where it does not; or UNDECIDED from there on, and why. What leads into
// a cone from its edge, or out to it, takes few steps: margins grow, or shrink, in proportion.
static nsvcd_verdict nsvcd__ask_cone(const nsvcd_checker *c, const nsvcd__kept_axis *cone,
                                     const nsvcd_joint_motion *m, double t0, double t1,
                                     const nsvcd_check_options *o, double *at,
                                     nsvcd_why *why) {
  const size_t joints = c->scene->joint_count;
  double length = t1 - t0;
  nsvcd__step step;
  double error, last_error;
  size_t polls = 0;
  *why = NSVCD_WHY_TOO_NEAR;
  *at = t0;
  nsvcd__joints_at_time(m, joints, t0, step.from, NULL);
  double last = nsvcd__cone_margin(c, cone, step.from, &last_error);
  if (last < last_error) return last < -last_error ? NSVCD_HIT : NSVCD_UNDECIDED;
  while (*at < t1) {
    if (++polls % NSVCD__CONE_POLL == 0 && o->stop && o->stop(o->user)) {
      *why = NSVCD_WHY_WORK;
      return NSVCD_UNDECIDED;
    }
    const double to = *at + length < t1 ? *at + length : t1;
    nsvcd__step_of(m, joints, *at, to, &step);
    const double next = nsvcd__cone_margin(c, cone, step.to, &error);
    const double deviation = nsvcd__axis_deviation(c, cone, &step);
    const double least = nsvcd__min(last - last_error, next - error);
    if (least >= deviation) {
      *at = to;
      last = next;
      last_error = error;
      length *= 2;
      continue;
    }
    length = 0.5 * (to - *at);
    if (next < -error) {
      *at = to;
      return NSVCD_HIT;
    }
    const double least_change = nsvcd__max(NSVCD__CONE_CHANGE * deviation, NSVCD__CONE_NOISE);
    const int stays = deviation <= NSVCD__CONE_FINEST && fabs(next - last) <= least_change;
    if (stays || !(*at + length > *at && *at + length < to)) return NSVCD_UNDECIDED;
  }
  return NSVCD_FREE;
}

// Do all axes stay in their cones from time t0 to t1? Else the answer says which one does not, or
// that the options' `stop` ended that, by NSVCD_WHY_WORK.
static int nsvcd__keeps_cones(const nsvcd_checker *c, const nsvcd_joint_motion *m, double t0,
                              double t1, const nsvcd_check_options *o,
                              nsvcd_check_answer *answer) {
  answer->cone = NSVCD_NONE;
  for (size_t n = 0; n < c->scene->cone_count; n++) {
    double at;
    nsvcd_why why;
    answer->verdict = nsvcd__ask_cone(c, &c->cones[n], m, t0, t1, o, &at, &why);
    if (answer->verdict == NSVCD_FREE) continue;
    memset(&answer->contact, 0, sizeof answer->contact);
    answer->cone = n;
    answer->pair = NSVCD_NONE;
    answer->why = answer->verdict == NSVCD_HIT ? NSVCD_WHY_NOTHING : why;
    answer->piece = nsvcd__piece_at(m, at);
    answer->fraction = nsvcd__fraction_at(m, answer->piece, at);
    return 0;
  }
  return 1;
}

// ---- configurations

// A joint's limits; of one that turns without, as far as values may go.
static double nsvcd__low_of(const nsvcd_joint *joint) {
  const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
  return is_endless ? -(double)NSVCD_MAX_COORDINATE : joint->low;
}
static double nsvcd__high_of(const nsvcd_joint *joint) {
  const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
  return is_endless ? (double)NSVCD_MAX_COORDINATE : joint->high;
}

static void nsvcd__clamp_to_limits(const nsvcd_scene *scene, double *joints) {
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    joints[j] = nsvcd__max(nsvcd__low_of(joint), nsvcd__min(nsvcd__high_of(joint), joints[j]));
  }
  nsvcd__follow(scene, 1, joints);
}

// The rotation vector of a turn that takes unit vector a to b. Of opposite ones it is about any
// axis across.
static nsvcd__d3 nsvcd__turn_between(nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 across = nsvcd__d3_cross(a, b);
  const double sine = nsvcd__d3_norm(across);
  const double cosine = nsvcd__d3_dot(a, b);
  if (sine > 1e-12) return nsvcd__d3_scale(across, nsvcd__atan2(sine, cosine) / sine);
  if (cosine > 0) return across;
  const nsvcd__d3 other = nsvcd__d3_of(fabs(a.x) < 0.6, fabs(a.x) >= 0.6, 0);
  const nsvcd__d3 axis = nsvcd__d3_cross(a, other);
  return nsvcd__d3_scale(axis, 3.141592653589793 / nsvcd__d3_norm(axis));
}

// How far axes are out of their cones, each narrowed to this share of its angle: radians, the root
// of the sum of their squares. slope: (F) by each joint, with those that it drives. *is_in: is each
// in its cone, and half way to the narrowed one?
static double nsvcd__cones_excess(nsvcd_checker *c, const double *q, double share,
                                  double *slope, int *is_in) {
  const size_t joints = c->scene->joint_count;
  double squares = 0;
  memset(slope, 0, joints * sizeof *slope);
  *is_in = 1;
  if (c->scene->cone_count > 0) nsvcd__place_links(c, q, c->at);
  for (size_t n = 0; n < c->scene->cone_count; n++) {
    const nsvcd__kept_axis *cone = &c->cones[n];
    const nsvcd__dpose *frame = &c->at->frames[cone->link];
    const nsvcd__d3 axis = nsvcd__dquat_rotate(frame->rotation, cone->axis);
    const nsvcd__d3 turn = nsvcd__turn_between(cone->direction, axis);
    const double angle = nsvcd__d3_norm(turn);
    const double excess = angle - share * cone->angle;
    if (!(excess > 0)) continue;
    *is_in &= angle <= 0.5 * (1 + share) * cone->angle;
    squares += excess * excess;
    for (size_t link = cone->link; link > 0; link = nsvcd__link_before(c, link)) {
      const double by = nsvcd__d3_dot(turn, c->at->axes[link - 1]) / angle;
      const size_t driver = nsvcd__driver(c->scene, link - 1);
      if (!nsvcd__slides(c, link - 1))
        slope[driver] += excess * by * nsvcd__rate(c->scene, link - 1);
    }
  }
  const double out = sqrt(squares);
  for (size_t j = 0; j < joints && out > 0; j++) slope[j] /= out;
  return out;
}

// Moves a configuration until all axes are in their cones, each narrowed to this share: Newton's
// method, by the least change of the joints that are not held. Returns 0 if that leads nowhere.
static int nsvcd__into_cones(nsvcd_checker *c, const uint8_t *held, double share, double *q) {
  double slope[NSVCD_MAX_JOINTS];
  int is_in;
  for (size_t n = 0; n < NSVCD__CONE_STEPS; n++) {
    const double excess = nsvcd__cones_excess(c, q, share, slope, &is_in);
    double squares = 0;
    if (is_in) return 1;
    for (size_t j = 0; j < c->scene->joint_count; j++)
      squares += held && held[j] ? 0 : slope[j] * slope[j];
    if (!(squares > NSVCD__CONE_SLOPE)) return 0;
    const double step = (NSVCD__CONE_FARTHER * excess + NSVCD__CONE_BEYOND) / squares;
    for (size_t j = 0; j < c->scene->joint_count; j++)
      q[j] -= held && held[j] ? 0 : step * slope[j];
    nsvcd__clamp_to_limits(c->scene, q);
  }
  return 0;
}

// ----------------------------------------------------------------------------------- robot/samples
// In: times of a motion. Out: its samples, where all parts are placed, and how far each part
// deviates in the steps between them; boxes about parts in a step.

// errors of frames in double, as a fraction of the lengths that they are computed from: of 32
// joints, and in proportion if there are more
#define NSVCD__FRAME_ROUNDING 1e-13
// from one call of a check's `stop` to the next
#define NSVCD__STOP_SAMPLES 8

// Places the parts that move, in a configuration, as sample k.
static void nsvcd__place_sample(nsvcd_checker *c, const nsvcd__links *at, size_t k) {
  const nsvcd_scene *scene = c->scene;
  const double rounding =
      NSVCD__FRAME_ROUNDING * nsvcd__max(1, (double)scene->joint_count / 32);
  double most = 0;
  for (size_t link = 1; link <= scene->joint_count; link++)
    most = nsvcd__max(most, nsvcd__d3_norm(at->frames[link].position));
  for (size_t n = 0; n < c->mover_count; n++) {
    nsvcd__member *m = &c->members[c->movers[n]];
    if (m->is_skipped) continue;
    const nsvcd__dpose frame = nsvcd__frame_of_part(c, at, c->movers[n]);
    const nsvcd__bounds bounds = nsvcd__bounds_of(m, &frame);
    c->frames[m->row + k] = frame;
    c->bounds[m->row + k] = bounds;
    m->bounds = k ? nsvcd__bounds_over(&m->bounds, &bounds) : bounds;
    // a joint adds some 5e-16 of its moment arm
    const double arm = most + nsvcd__d3_norm(frame.position) + m->extent;
    m->rounding = nsvcd__max(k ? m->rounding : 0, rounding * arm);
  }
}

// Places the parts that move at c->times, one more than steps, and computes how far they deviate.
// If the caller says stop, not all of that is done.
static void nsvcd__sample(nsvcd_checker *c, const nsvcd_joint_motion *motion, size_t steps) {
  const size_t joints = c->scene->joint_count;
  nsvcd__step step;
  nsvcd__links *from = c->at;
  nsvcd__links *to = c->next;
  for (size_t n = 0; n < c->mover_count; n++) c->members[c->movers[n]].deviation = 0;
  nsvcd_motion_at(motion, joints, c->times[0], step.from);
  nsvcd__place_links(c, step.from, from);
  nsvcd__place_sample(c, from, 0);
  for (size_t k = 0; k < steps; k++) {
    if (k % NSVCD__STOP_SAMPLES + 1 == NSVCD__STOP_SAMPLES && c->stop && c->stop(c->user))
      return;
    nsvcd__step_of(motion, joints, c->times[k], c->times[k + 1], &step);
    nsvcd__place_links(c, step.to, to);
    nsvcd__place_sample(c, to, k + 1);
    for (size_t n = 0; n < c->mover_count; n++) {
      const size_t part = c->movers[n];
      nsvcd__member *m = &c->members[part];
      if (m->is_skipped) continue;
      const double most = nsvcd__part_deviation(c, part, &step, from, to) * (1 + 1e-9);
      c->deviations[m->row + k] = most;
      m->deviation = nsvcd__max(m->deviation, most);
    }
    nsvcd__links *other = from;
    from = to;
    to = other;
  }
}

// Cuts steps so that no part deviates by more than is allowed where it is near another, as far as
// can be foreseen: the deviation goes with the square of a step. Returns how many steps there are
// then; where they are more than NSVCD__MOST_STEPS, the times stay as they were.
static size_t nsvcd__refine_steps(nsvcd_checker *c, size_t steps, double allowed) {
  size_t total = 0;
  for (size_t k = 0; k < steps; k++) {
    const double cuts = ceil(sqrt(c->coarse[k] / allowed));
    if (!(cuts <= NSVCD__MOST_STEPS)) return NSVCD__MOST_STEPS + 1;
    total += cuts > 1 ? (size_t)cuts : 1;
  }
  if (total > NSVCD__MOST_STEPS) return total;
  size_t at = total;
  c->times[total] = c->times[steps];
  for (size_t k = steps; k-- > 0;) {
    const double cuts = nsvcd__max(ceil(sqrt(c->coarse[k] / allowed)), 1);
    const double from = c->times[k];
    const double duration = c->times[at] - from;
    for (size_t i = (size_t)cuts; i-- > 0;)
      c->times[--at] = from + duration * (double)i / cuts;
  }
  return total;
}

// A box about a part at both ends of a step; in between it goes no farther than it deviates.
static nsvcd__bounds nsvcd__bounds_in(const nsvcd_checker *c, size_t part, size_t step) {
  const nsvcd__member *m = &c->members[part];
  const nsvcd__bounds *at = c->bounds + m->row + step;
  return c->scene->parts[part].link ? nsvcd__bounds_over(at, at + 1) : m->bounds;
}

static double nsvcd__deviation_in(const nsvcd_checker *c, size_t part, size_t step) {
  return c->scene->parts[part].link ? c->deviations[c->members[part].row + step] : 0;
}

// The steps outside of which the boxes of a pair stay apart; none for a single configuration. And
// by how much the two can be off their sweeps in them, together, in the frames of the samples.
typedef struct nsvcd__step_range {
  size_t first, steps;
  double error;
} nsvcd__step_range;

// Where does a pair come as near as `kept`, by its boxes? Returns 0 if nowhere.
static int nsvcd__steps_near(const nsvcd_checker *c, const nsvcd_body_pair *pair, size_t steps,
                             double kept, nsvcd__step_range *range) {
  const nsvcd__member *a = &c->members[pair->a];
  const nsvcd__member *b = &c->members[pair->b];
  const double rounding = 2 * (a->rounding + b->rounding);
  const double room = (kept + rounding) * (1 + 1e-9);
  const double most = (a->deviation + b->deviation) * (1 + 1e-9);
  size_t last = 0;
  if (nsvcd__bounds_apart(&a->bounds, &b->bounds, room + most)) return 0;
  range->first = steps;
  for (size_t k = 0; k < steps; k++) {
    const nsvcd__bounds at_a = nsvcd__bounds_in(c, pair->a, k);
    const nsvcd__bounds at_b = nsvcd__bounds_in(c, pair->b, k);
    const double off = nsvcd__deviation_in(c, pair->a, k) + nsvcd__deviation_in(c, pair->b, k);
    if (nsvcd__bounds_apart(&at_a, &at_b, room + off * (1 + 1e-9))) continue;
    if (range->first == steps) range->first = k;
    last = k + 1;
  }
  range->error = 0;
  for (size_t k = range->first; k < last; k++) {
    const double off = nsvcd__deviation_in(c, pair->a, k) + nsvcd__deviation_in(c, pair->b, k);
    range->error = nsvcd__max(range->error, off);
  }
  range->error += rounding;
  range->steps = last - (steps ? range->first : 0);
  return steps == 0 || last > 0;
}

// The frames of a part from a sample on; of one that rests there is only one.
static const nsvcd__dpose *nsvcd__frames_at(const nsvcd_checker *c, size_t part,
                                            size_t sample) {
  const nsvcd__member *m = &c->members[part];
  return c->scene->parts[part].link ? c->frames + m->row + sample : &m->frame;
}

// ----------------------------------------------------------------------------- robot/local_queries
// In: two parts of a pair, and their frames. Out: a question about them, as one of them sees it.
//
// Poses in float keep their digits where coordinates are small. Those of two parts that are near
// each other are, however far from the world's origin, in the frame of one of them: of the part
// that rests, if one does; else of b, half way.

// The frame that local poses are in.
typedef struct nsvcd__local {
  // in the world
  nsvcd__dpose frame;
  // metres, at most: the sum of both parts' errors by poses in float
  double rounding;
} nsvcd__local;

// Fills in c->local. frames: of a and of b, (count) each, but one of a part that rests.
static nsvcd__local nsvcd__localize(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                    const nsvcd__dpose *const *frames, size_t count) {
  const size_t parts[2] = {pair->a, pair->b};
  const int moves[2] = {c->scene->parts[pair->a].link > 0, c->scene->parts[pair->b].link > 0};
  nsvcd__local local = {moves[0] ? frames[1][moves[1] ? count / 2 : 0] : frames[0][0], 0};
  for (size_t n = 0; n < 2; n++) {
    double most = 0;
    for (size_t k = 0; k < (moves[n] ? count : 1); k++) {
      const nsvcd__dpose in = nsvcd__dpose_inverse_mul(&local.frame, &frames[n][k]);
      c->local[n][k] = nsvcd__dpose_round(&in);
      most = nsvcd__max(most, nsvcd__d3_norm(in.position));
    }
    // of positions and of quaternions as floats
    if (moves[n]) local.rounding += 2 * (1.1e-7 * most + 1.3e-7 * c->members[parts[n]].extent);
  }
  return local;
}

// The same in the configuration c->at.
static nsvcd__local nsvcd__localize_at(nsvcd_checker *c, const nsvcd_body_pair *pair) {
  const nsvcd__dpose a = nsvcd__frame_of_part(c, c->at, pair->a);
  const nsvcd__dpose b = nsvcd__frame_of_part(c, c->at, pair->b);
  const nsvcd__dpose *const frames[2] = {&a, &b};
  return nsvcd__localize(c, pair, frames, 1);
}

// Takes a contact from the local frame to the world.
static void nsvcd__contact_to_world(const nsvcd__local *local, nsvcd_contact *contact) {
  const nsvcd__dpose *frame = &local->frame;
  const nsvcd__d3 point = nsvcd__dpose_apply(frame, nsvcd__d3_load(contact->point));
  const nsvcd__d3 normal =
      nsvcd__dquat_rotate(frame->rotation, nsvcd__d3_load(contact->normal));
  nsvcd__f3_store(nsvcd__f3_round(point), contact->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), contact->normal);
}

// Of two parts in their local poses, (count) each, but one of a part that rests.
static nsvcd_question nsvcd__question_of(const nsvcd_checker *c, const nsvcd_body_pair *pair,
                                         size_t count, size_t work) {
  const size_t parts[2] = {pair->a, pair->b};
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_part *part = &c->scene->parts[parts[n]];
    nsvcd_mover *mover = n ? &q.b : &q.a;
    mover->body = part->body;
    mover->scale = part->scale;
    mover->poses = c->local[n];
    mover->count = part->link ? count : 1;
  }
  q.method = NSVCD_METHOD_PROOF;
  q.surfaces = c->surfaces;
  q.work = work ? work : NSVCD_DEFAULT_WORK;
  return q;
}

// Returns the verdict; UNDECIDED where c->result is an error.
static nsvcd_verdict nsvcd__ask_sweep(nsvcd_checker *c, const nsvcd_question *q,
                                      nsvcd_answer *found) {
  memset(found, 0, sizeof *found);
  nsvcd_question asked = *q;
  asked.stop = c->stop;
  asked.user = c->user;
  if (!c->result) c->result = nsvcd_sweep(&asked, c->query, c->query_size, found);
  c->units += found->work;
  return found->verdict;
}

// ------------------------------------------------------------------------------------- robot/check
// In: a checker and a motion of its joints. Out: is it free, as the joints make it, at all times?
//
// A motion is checked from corner to corner. Each such interval is cut into steps in which no part
// deviates by more than is allowed. One sweep asks about a pair in all steps, with the deviations
// added to the clearance. Pairs that this does not prove are asked about again in finer steps.

// how often an interval that takes more than NSVCD__MOST_STEPS may be halved
#define NSVCD__CHECK_HALVINGS 24
// steps of an interval that is not a straight line, at first
#define NSVCD__FIRST_STEPS 4
// radians or metres: no sample is put where a motion bends by less
#define NSVCD__CORNER 1e-3
// metres that a part may deviate at first; the divisor each time that pairs are asked about again;
// the last of these, by default
#define NSVCD__COARSE 2e-3
#define NSVCD__CHECK_FINER 8
#define NSVCD__FINEST 1e-5f
// units of a try to find a hit, but for the last one
#define NSVCD__HIT_TRY 200

typedef struct nsvcd__check_state {
  nsvcd_checker *checker;
  const nsvcd_joint_motion *motion;
  const nsvcd_check_options *options;
  nsvcd_check_answer *answer;
  // between samples; 0: one configuration
  size_t steps;
  int is_stopped;
} nsvcd__check_state;

// Has the caller said stop? Once that is so, it is not asked again. user: the state.
static int nsvcd__check_stops(void *user) {
  nsvcd__check_state *s = (nsvcd__check_state *)user;
  const nsvcd_check_options *o = s->options;
  if (!s->is_stopped && o->stop && o->stop(o->user)) s->is_stopped = 1;
  return s->is_stopped;
}

// ---- pairs

// Do two parts, in their local poses, come as near as the clearance?
static nsvcd_verdict nsvcd__ask_local(nsvcd__check_state *s, const nsvcd_body_pair *pair,
                                      size_t count, float clearance, size_t work,
                                      nsvcd_answer *found) {
  nsvcd_question question = nsvcd__question_of(s->checker, pair, count, work);
  question.clearance = clearance;
  if (nsvcd__check_stops(s)) {
    memset(found, 0, sizeof *found);
    found->why = NSVCD_WHY_WORK;
    return NSVCD_UNDECIDED;
  }
  s->answer->sweeps++;
  return nsvcd__ask_sweep(s->checker, &question, found);
}

// The distance that a pair is to keep.
static double nsvcd__clearance_of(const nsvcd__check_state *s, const nsvcd_body_pair *pair) {
  const nsvcd_scene *scene = s->checker->scene;
  const float *own = scene->clearances;
  return (double)s->options->clearance + (own ? (double)own[pair - scene->pairs] : 0);
}

// Does a pair, on its sweeps between samples, come as near as the clearance? For a proof the errors
// of these sweeps are added to it. range: the steps that were asked about; the times of *found are
// fractions of it.
static nsvcd_verdict nsvcd__ask_pair(nsvcd__check_state *s, const nsvcd_body_pair *pair,
                                     int is_proof, size_t work, nsvcd__step_range *range,
                                     nsvcd_answer *found) {
  nsvcd_checker *c = s->checker;
  const double kept = nsvcd__clearance_of(s, pair);
  if (!nsvcd__steps_near(c, pair, s->steps, kept, range)) return NSVCD_FREE;
  const size_t count = range->steps + 1;
  const nsvcd__dpose *const frames[2] = {nsvcd__frames_at(c, pair->a, range->first),
                                         nsvcd__frames_at(c, pair->b, range->first)};
  const nsvcd__local local = nsvcd__localize(c, pair, frames, count);
  const double errors = is_proof ? range->error + local.rounding : 0;
  const double clearance = kept + errors;
  const float rounded = clearance > 0 ? nsvcd__above(clearance) : 0;
  return nsvcd__ask_local(s, pair, count, rounded, work, found);
}

// Is the answer's pair hit in the configuration that the answer names? Then it becomes a HIT.
static int nsvcd__is_hit_there(nsvcd__check_state *s, size_t work) {
  nsvcd_checker *c = s->checker;
  nsvcd_check_answer *answer = s->answer;
  const nsvcd_body_pair *pair = &c->scene->pairs[answer->pair];
  const float clearance = (float)nsvcd__clearance_of(s, pair);
  double joints[NSVCD_MAX_JOINTS];
  nsvcd_answer found;
  nsvcd__joints_at(s->motion, c->scene->joint_count, answer->piece, answer->fraction, joints,
                   NULL);
  nsvcd__place_links(c, joints, c->at);
  answer->placed++;
  const nsvcd__local local = nsvcd__localize_at(c, pair);
  if (nsvcd__ask_local(s, pair, 1, clearance, work, &found) != NSVCD_HIT) return 0;
  answer->verdict = NSVCD_HIT;
  answer->contact = found.nearest;
  nsvcd__contact_to_world(&local, &answer->contact);
  return 1;
}

// Is a pair that is not proven hit in some configuration? Tries two: where it came nearest in its
// proof, which is *found; then where its sweeps between samples hit.
static int nsvcd__seek_hit(nsvcd__check_state *s, size_t pair, nsvcd__step_range *range,
                           nsvcd_answer *found, size_t work) {
  nsvcd_checker *c = s->checker;
  nsvcd_check_answer *answer = s->answer;
  answer->pair = pair;
  answer->why = found->why;
  for (int attempt = 0; attempt < 2; attempt++) {
    if (s->steps > 0) {
      // a sweep takes all steps to be equally long
      const double u = nsvcd__max(0, nsvcd__min(1, (double)found->nearest.time));
      const double at = (double)range->steps * u;
      const size_t step = (size_t)at < range->steps ? (size_t)at : range->steps - 1;
      const double *times = c->times + range->first + step;
      const double time = times[0] + (at - (double)step) * (times[1] - times[0]);
      answer->piece = nsvcd__piece_at(s->motion, time);
      answer->fraction = nsvcd__fraction_at(s->motion, answer->piece, time);
    }
    if (nsvcd__is_hit_there(s, work)) return 1;
    if (attempt == 0 && !s->is_stopped &&
        nsvcd__ask_pair(s, &c->scene->pairs[pair], 0, work, range, found) == NSVCD_FREE)
      return 0;
  }
  return 0;
}

// Puts a pair first in the order.
static void nsvcd__put_first(nsvcd_checker *c, size_t pair) {
  size_t at = 0;
  while (c->order[at] != pair) at++;
  for (; at > 0; at--) c->order[at] = c->order[at - 1];
  c->order[0] = (uint32_t)pair;
}

// Asks about the first `left` pairs of c->left, until one is hit. Keeps those that stay unproven,
// and returns how many they are.
static size_t nsvcd__ask_pairs(nsvcd__check_state *s, int is_last, size_t left) {
  nsvcd_checker *c = s->checker;
  const size_t work = s->options->work;
  const size_t brief = work && work < NSVCD__HIT_TRY ? work : NSVCD__HIT_TRY;
  size_t kept = 0;
  for (size_t n = 0; n < left && !c->result && !s->is_stopped; n++) {
    const size_t pair = c->left[n];
    const nsvcd_body_pair *parts = &c->scene->pairs[pair];
    nsvcd__step_range range;
    nsvcd_answer found;
    if (nsvcd__ask_pair(s, parts, 1, work, &range, &found) == NSVCD_FREE) continue;
    if (nsvcd__seek_hit(s, pair, &range, &found, is_last ? work : brief)) {
      nsvcd__put_first(c, pair);
      return left;
    }
    c->left[kept++] = (uint32_t)pair;
  }
  return kept;
}

// ---- intervals

// Samples the parts of the first `left` pairs of c->left.
static void nsvcd__take_samples(nsvcd__check_state *s, size_t steps, size_t left) {
  nsvcd_checker *c = s->checker;
  for (size_t n = 0; n < c->mover_count; n++) c->members[c->movers[n]].is_skipped = 1;
  for (size_t n = 0; n < left; n++) {
    const nsvcd_body_pair *pair = &c->scene->pairs[c->left[n]];
    c->members[pair->a].is_skipped = c->members[pair->b].is_skipped = 0;
  }
  s->steps = steps;
  nsvcd__sample(c, s->motion, steps);
  s->answer->placed += steps + 1;
}

// Notes how far parts deviate at most in each step, of the first `left` pairs of c->left where
// these are near.
static void nsvcd__note_coarse(nsvcd__check_state *s, size_t left) {
  nsvcd_checker *c = s->checker;
  memset(c->coarse, 0, s->steps * sizeof *c->coarse);
  for (size_t n = 0; n < left; n++) {
    const nsvcd_body_pair *pair = &c->scene->pairs[c->left[n]];
    nsvcd__step_range range;
    if (!nsvcd__steps_near(c, pair, s->steps, nsvcd__clearance_of(s, pair), &range)) continue;
    for (size_t k = range.first; k < range.first + range.steps; k++) {
      const double a = nsvcd__deviation_in(c, pair->a, k);
      const double b = nsvcd__deviation_in(c, pair->b, k);
      c->coarse[k] = nsvcd__max(c->coarse[k], nsvcd__max(a, b));
    }
  }
}

// From time t0 to t1, in so many steps at first; with none it is one configuration. An interval
// that takes too many steps is halved, so often at most.
static void nsvcd__check_interval(nsvcd__check_state *s, double t0, double t1, size_t steps,
                                  int halvings) {
  nsvcd_checker *c = s->checker;
  nsvcd_check_answer *answer = s->answer;
  const double finest = (double)s->options->finest;
  size_t left = 0;
  if (!nsvcd__keeps_cones(c, s->motion, t0, t1, s->options, answer)) {
    s->is_stopped |= answer->why == NSVCD_WHY_WORK;
    return;
  }
  answer->verdict = NSVCD_UNDECIDED;
  answer->piece = nsvcd__piece_at(s->motion, t0);
  answer->fraction = nsvcd__fraction_at(s->motion, answer->piece, t0);
  for (size_t n = 0; n < c->scene->pair_count; n++) {
    const size_t pair = c->order[n];
    if (!nsvcd__pair_is_allowed(c, pair, s->motion, t0, t1)) c->left[left++] = (uint32_t)pair;
  }
  for (size_t k = 0; k <= steps; k++)
    c->times[k] = k < steps ? t0 + (t1 - t0) * (double)k / (double)steps : t1;
  nsvcd__take_samples(s, steps, left);
  double allowed = NSVCD__COARSE;
  while (left > 0) {
    answer->why = NSVCD_WHY_WORK;
    // not all is sampled
    if (s->is_stopped) return;
    nsvcd__note_coarse(s, left);
    const size_t finer = nsvcd__refine_steps(c, s->steps, allowed);
    if (finer > NSVCD__MOST_STEPS) {
      const double middle = 0.5 * (t0 + t1);
      const size_t coarse = s->steps;
      if (halvings == 0 || !(middle > t0 && middle < t1)) return;
      nsvcd__check_interval(s, t0, middle, coarse, halvings - 1);
      if (answer->verdict == NSVCD_FREE)
        nsvcd__check_interval(s, middle, t1, coarse, halvings - 1);
      return;
    }
    if (finer > s->steps) nsvcd__take_samples(s, finer, left);
    const int is_last = s->steps == 0 || allowed <= finest;
    if (!s->is_stopped) left = nsvcd__ask_pairs(s, is_last, left);
    if (s->is_stopped && answer->verdict != NSVCD_HIT) answer->why = NSVCD_WHY_WORK;
    if (c->result || answer->verdict == NSVCD_HIT || s->is_stopped || (is_last && left > 0))
      return;
    allowed = nsvcd__max(allowed / NSVCD__CHECK_FINER, finest);
  }
  answer->pair = NSVCD_NONE;
  answer->verdict = NSVCD_FREE;
  answer->free_until = t1;
}

// Until when is a motion free that is not, and is free until answer->free_until at least? By halves
// of what is open, up to time `end`. The first hit that is found is the answer's.
static void nsvcd__seek_first(nsvcd__check_state *s, double end) {
  nsvcd_check_answer *answer = s->answer;
  double high = end;
  while (!s->checker->result && !s->is_stopped) {
    const nsvcd_check_answer last = *answer;
    if (last.verdict == NSVCD_HIT) {
      const double start = nsvcd__piece_start(s->motion, last.piece);
      const double time = start + last.fraction * nsvcd__piece_time(s->motion, last.piece);
      high = nsvcd__min(high, time);
    }
    const double low = last.free_until;
    const double middle = low + 0.5 * (high - low);
    if (!(high - low > s->options->to_time) || !(middle > low && middle < high)) return;
    nsvcd__check_interval(s, low, middle, NSVCD__FIRST_STEPS, NSVCD__CHECK_HALVINGS);
    if (answer->verdict == NSVCD_HIT) continue;
    const nsvcd_check_answer found = *answer;
    *answer = last;
    answer->placed = found.placed;
    answer->sweeps = found.sweeps;
    answer->free_until = found.free_until;
    if (found.verdict != NSVCD_FREE) high = middle;
  }
}

// Does the motion turn sharply where a piece begins? Then a sample belongs there.
static int nsvcd__is_corner(const nsvcd_joint_motion *motion, size_t joints, size_t piece) {
  const double before = nsvcd__piece_time(motion, piece - 1);
  const double after = nsvcd__piece_time(motion, piece);
  double jumps = 0;
  for (size_t j = 0; j < joints; j++) jumps += nsvcd__jump_at(motion, joints, piece, j);
  return !(jumps * nsvcd__min(before, after) <= NSVCD__CORNER);
}

// ---- limits

// By how much a joint may be out of its limits: rounding.
static double nsvcd__limit_error(const nsvcd_joint *joint) {
  return 1e-9 * (1 + fabs(joint->low) + fabs(joint->high));
}

// Does a curve leave the interval from low to high? Halved until all its control points are in it,
// or an end is out.
static int nsvcd__curve_leaves(const double *points, size_t degree, double low, double high,
                               int depth) {
  double half[2][NSVCD_MAX_DEGREE + 1];
  int inside = 1;
  for (size_t i = 0; i <= degree; i++) inside &= points[i] >= low && points[i] <= high;
  if (inside) return 0;
  if (depth == 0 || !(points[0] >= low && points[0] <= high)) return 1;
  if (!(points[degree] >= low && points[degree] <= high)) return 1;
  for (size_t k = 0; k < 2; k++) {
    memcpy(half[k], points, (degree + 1) * sizeof *points);
    nsvcd__cut_curve(half[k], degree, k ? 0.5 : 0, k ? 1 : 0.5);
    if (nsvcd__curve_leaves(half[k], degree, low, high, depth - 1)) return 1;
  }
  return 0;
}

// A joint that leaves its limits in a piece by more than rounding, or NSVCD_NONE.
static size_t nsvcd__joint_outside(const nsvcd_scene *scene, const nsvcd_joint_motion *motion,
                                   size_t piece) {
  double p[NSVCD_MAX_DEGREE + 1];
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    nsvcd__joint_points(motion, piece, scene->joint_count, j, p);
    const double error = nsvcd__limit_error(joint);
    if (nsvcd__curve_leaves(p, motion->degree, joint->low - error, joint->high + error, 30))
      return j;
  }
  return NSVCD_NONE;
}

// ---- a check

// Are a motion's pieces in order? Of no pieces it must be as nsvcd__motion_meant has it.
static nsvcd_result nsvcd__pieces_check(const nsvcd_joint_motion *m, size_t joints) {
  if (m->pieces && (m->degree < 1 || m->degree > NSVCD_MAX_DEGREE)) return NSVCD_ERROR_DEGREE;
  if (m->pieces > SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints)
    return NSVCD_ERROR_DEGREE;
  if (!nsvcd__are_numbers(m->points, (m->pieces * m->degree + 1) * joints))
    return NSVCD_ERROR_VALUE;
  if (m->times && !nsvcd__are_numbers(m->times, m->pieces + 1)) return NSVCD_ERROR_TIMES;
  for (size_t p = 0; p < m->pieces && m->times; p++) {
    if (!(m->times[p + 1] > m->times[p])) return NSVCD_ERROR_TIMES;
  }
  return NSVCD_OK;
}

// Is it a motion of the scene's joints?
static nsvcd_result nsvcd__motion_check(const nsvcd_scene *scene,
                                        const nsvcd_joint_motion *m) {
  const nsvcd_result result = nsvcd__pieces_check(m, scene->joint_count);
  if (result) return result;
  const int follows = nsvcd__follows(scene, m->pieces * m->degree + 1, m->points);
  return follows ? NSVCD_OK : NSVCD_ERROR_MIMIC;
}

NSVCDDEF nsvcd_result nsvcd_allowed_until(const nsvcd_checker *c,
                                          const nsvcd_allowance *allowance,
                                          const nsvcd_joint_motion *motion, int back,
                                          double *time) {
  if (!c || !allowance || !motion || !motion->points || !time) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  nsvcd_result result = nsvcd__allowance_check(c->scene, allowance);
  if (!result) result = nsvcd__motion_check(c->scene, &m);
  if (result) return result;
  const double ends[2] = {nsvcd__piece_start(&m, 0), nsvcd__piece_start(&m, m.pieces)};
  *time = nsvcd__allowed_up_to(c, allowance, &m, ends[back != 0], ends[back == 0]);
  return NSVCD_OK;
}

// Is it free, and within the limits?
static int nsvcd__proves_free(const nsvcd_check_answer *answer) {
  return answer->verdict == NSVCD_FREE && answer->joint == NSVCD_NONE;
}

NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_check_answer found;
  nsvcd_check_options o;
  if (!c || !motion || !answer || !motion->points) return NSVCD_ERROR_ARGUMENT;
  const size_t joints = c->scene->joint_count;
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  const nsvcd_result result = nsvcd__motion_check(c->scene, &m);
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_finite(o.clearance) || o.clearance < 0) return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_finite(o.finest) || o.finest < 0) return NSVCD_ERROR_FINEST;
  if (!nsvcd__are_numbers(&o.to_time, 1) || o.to_time < 0) return NSVCD_ERROR_TO;
  o.finest = o.finest > 0 ? o.finest : NSVCD__FINEST;
  memset(&found, 0, sizeof found);
  found.joint = found.pair = found.piece = found.cone = NSVCD_NONE;
  nsvcd__check_state s = {c, &m, &o, &found, 0, 0};
  int (*const stop)(void *user) = c->stop;
  void *const user = c->user;
  c->stop = o.stop ? nsvcd__check_stops : NULL;
  c->user = &s;
  for (size_t p = 0; p < m.pieces + !m.pieces && found.joint == NSVCD_NONE; p++)
    found.joint = nsvcd__joint_outside(c->scene, &m, p);
  c->result = NSVCD_OK;
  if (m.pieces == 0) nsvcd__check_interval(&s, 0, 0, 0, 0);
  if (m.pieces > 0) nsvcd__note_cuts(c, &m);
  found.free_until = nsvcd__piece_start(&m, 0);
  // from corner to corner
  for (size_t p = 0, next; p < m.pieces; p = next) {
    next = p + 1;
    while (next < m.pieces && !nsvcd__is_corner(&m, joints, next)) next++;
    const size_t steps = next - p == 1 && m.degree == 1 ? 1 : NSVCD__FIRST_STEPS;
    const double end = nsvcd__piece_start(&m, next);
    found.verdict = NSVCD_FREE;
    for (double t0 = nsvcd__piece_start(&m, p), t1; t0 < end; t0 = t1) {
      t1 = nsvcd__next_cut(c, t0, end);
      nsvcd__check_interval(&s, t0, t1, steps, NSVCD__CHECK_HALVINGS);
      if (found.verdict == NSVCD_FREE) continue;
      if (o.to_time > 0) nsvcd__seek_first(&s, t1);
      break;
    }
    if (found.verdict != NSVCD_FREE) break;
  }
  for (size_t n = 0; n < c->mover_count; n++) c->members[c->movers[n]].is_skipped = 0;
  c->stop = stop;
  c->user = user;
  if (c->result) return c->result;
  if (found.verdict == NSVCD_FREE) {
    found.piece = NSVCD_NONE;
    found.fraction = 0;
    found.why = NSVCD_WHY_NOTHING;
  }
  *answer = found;
  return NSVCD_OK;
}

// ------------------------------------------------------------------------------------- robot/merge
// In: motions of some of the joints, each on a clock of its own. Out: one motion of all joints.

// of the time of the whole: times that are no farther apart are one
#define NSVCD__ONE_TIME 1e-12

// What motions have in common.
typedef struct nsvcd__merge {
  size_t joints;
  // that a merged motion can have, at most; its degree
  size_t pieces, degree;
  // seconds: times that are no farther apart are one
  double same;
  // joints that some motion moves
  uint8_t moved[NSVCD_MAX_JOINTS];
} nsvcd__merge;

// When a piece begins, or the last one ends, on the clock of all.
static double nsvcd__knot_at(const nsvcd_partial_motion *m, size_t piece) {
  return m->delay + nsvcd__piece_start(&m->motion, piece);
}

// Are the motions in order? Fills in *all.
static nsvcd_result nsvcd__merge_check(const nsvcd_partial_motion *motions, size_t count,
                                       size_t joints, nsvcd__merge *all) {
  double first = 0;
  double last = 0;
  memset(all, 0, sizeof *all);
  all->joints = joints;
  all->degree = 1;
  if (joints < 1 || joints > NSVCD_MAX_JOINTS) return NSVCD_ERROR_COUNT;
  if (count > 0 && !motions) return NSVCD_ERROR_ARGUMENT;
  const size_t most = SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints / 2;
  for (size_t n = 0; n < count; n++) {
    const nsvcd_partial_motion *m = &motions[n];
    const nsvcd_joint_motion meant = nsvcd__motion_meant(&m->motion);
    if (!m->joints || !meant.points) return NSVCD_ERROR_ARGUMENT;
    if (m->joint_count < 1 || m->joint_count > joints) return NSVCD_ERROR_COUNT;
    for (size_t k = 0; k < m->joint_count; k++) {
      if (m->joints[k] >= joints || all->moved[m->joints[k]]++) return NSVCD_ERROR_JOINT;
    }
    const nsvcd_result result = nsvcd__pieces_check(&meant, m->joint_count);
    if (result) return result;
    if (!nsvcd__are_numbers(&m->delay, 1)) return NSVCD_ERROR_TIMES;
    if (meant.pieces == 0) continue;
    if (meant.pieces >= most - all->pieces) return NSVCD_ERROR_DEGREE;
    const double begin = nsvcd__knot_at(m, 0);
    const double end = nsvcd__knot_at(m, meant.pieces);
    first = all->pieces ? nsvcd__min(first, begin) : begin;
    last = all->pieces ? nsvcd__max(last, end) : end;
    all->pieces += meant.pieces + 1;
    if (meant.degree > all->degree) all->degree = meant.degree;
  }
  all->same = NSVCD__ONE_TIME * (last - first);
  for (size_t n = 0; n < count; n++) {
    const nsvcd_partial_motion *m = &motions[n];
    for (size_t p = 0; p < m->motion.pieces; p++)
      if (!(nsvcd__knot_at(m, p + 1) - nsvcd__knot_at(m, p) > all->same))
        return NSVCD_ERROR_TIMES;
  }
  return NSVCD_OK;
}

// Writes the times at which pieces of any motion begin or end, rising. Returns how many they are.
static size_t nsvcd__merge_times(const nsvcd_partial_motion *motions, size_t count,
                                 double same, double *times) {
  size_t next[NSVCD_MAX_JOINTS] = {0};
  for (size_t written = 0;; written++) {
    int is_over = 1;
    for (size_t n = 0; n < count; n++) {
      if (motions[n].motion.pieces == 0 || next[n] > motions[n].motion.pieces) continue;
      const double time = nsvcd__knot_at(&motions[n], next[n]);
      if (is_over || time < times[written]) times[written] = time;
      is_over = 0;
    }
    if (is_over) return written;
    for (size_t n = 0; n < count; n++) {
      if (motions[n].motion.pieces == 0 || next[n] > motions[n].motion.pieces) continue;
      next[n] += nsvcd__knot_at(&motions[n], next[n]) <= times[written] + same;
    }
  }
}

// Raises the degree of a curve. Points that are the same stay so, and so do the ends.
static void nsvcd__raise_degree(double *p, size_t degree, size_t to) {
  for (; degree < to; degree++) {
    const double whole = (double)(degree + 1);
    p[degree + 1] = p[degree];
    for (size_t i = degree; i > 0; i--) p[i] += (double)i / whole * (p[i - 1] - p[i]);
  }
}

// Writes one joint of a motion, its column k, into the merged one, whose times are known. A piece
// goes from one of these to another, and is cut at those in between.
static void nsvcd__merge_joint(const nsvcd_partial_motion *m, size_t k,
                               const nsvcd__merge *all, const nsvcd_joint_motion *merged,
                               double *points) {
  const size_t own = m->motion.pieces;
  const size_t degree = all->degree;
  double *column = points + m->joints[k];
  size_t row = 0;
  size_t at = 0;
  while (own > 0 && nsvcd__knot_at(m, 0) > merged->times[at] + all->same) at++;
  for (; row <= at * degree; row++) column[row * all->joints] = m->motion.points[k];
  for (size_t piece = 0; piece < own; piece++) {
    size_t end = at + 1;
    while (nsvcd__knot_at(m, piece + 1) > merged->times[end] + all->same) end++;
    const double start = merged->times[at];
    const double whole = merged->times[end] - start;
    for (; at < end; at++) {
      double p[NSVCD_MAX_DEGREE + 1];
      const double to = at + 1 < end ? (merged->times[at + 1] - start) / whole : 1;
      nsvcd__joint_points(&m->motion, piece, m->joint_count, k, p);
      nsvcd__cut_curve(p, m->motion.degree, (merged->times[at] - start) / whole, to);
      nsvcd__raise_degree(p, m->motion.degree, degree);
      for (size_t i = 0; i <= degree; i++) column[(at * degree + i) * all->joints] = p[i];
    }
    row = at * degree + 1;
  }
  for (; row <= merged->pieces * degree; row++)
    column[row * all->joints] = column[(row - 1) * all->joints];
}

// Lays a merged motion out at base, which is aligned, or, where that is NULL, only counts. Returns
// the bytes; 0 if they are more than can be counted.
static size_t nsvcd__merge_layout(const nsvcd__merge *all, char *base, double **points,
                                  double **times) {
  uint64_t used = 0;
  const size_t rows = all->pieces * all->degree + 1;
  *points = NSVCD__TAKE_ROWS(double, (rows * all->joints), base, &used);
  *times = NSVCD__TAKE_ROWS(double, all->pieces + 1, base, &used);
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_merge_motions_size(const nsvcd_partial_motion *motions, size_t count,
                                         size_t joints) {
  nsvcd__merge all;
  double *unused[2];
  if (nsvcd__merge_check(motions, count, joints, &all)) return 0;
  return nsvcd__merge_layout(&all, NULL, &unused[0], &unused[1]);
}

NSVCDDEF nsvcd_result nsvcd_merge_motions(const nsvcd_partial_motion *motions, size_t count,
                                          size_t joints, const double *rest, void *memory,
                                          size_t size, nsvcd_joint_motion *merged) {
  nsvcd__merge all;
  double *points, *times;
  const nsvcd_result result = nsvcd__merge_check(motions, count, joints, &all);
  if (result) return result;
  if (!merged) return NSVCD_ERROR_ARGUMENT;
  for (size_t j = 0; j < joints; j++) {
    if (all.moved[j]) continue;
    if (!rest) return NSVCD_ERROR_ARGUMENT;
    if (!nsvcd__are_numbers(&rest[j], 1)) return NSVCD_ERROR_VALUE;
  }
  const size_t needed = nsvcd__merge_layout(&all, NULL, &points, &times);
  if (!memory || !nsvcd__is_aligned(memory) || !needed || size < needed)
    return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__merge_layout(&all, (char *)memory, &points, &times);
  const size_t knots = nsvcd__merge_times(motions, count, all.same, times);
  const nsvcd_joint_motion out = {knots ? knots - 1 : 0, all.degree, points, times};
  for (size_t row = 0; row <= out.pieces * out.degree; row++) {
    for (size_t j = 0; j < joints; j++)
      if (!all.moved[j]) points[row * joints + j] = rest[j];
  }
  for (size_t n = 0; n < count; n++) {
    for (size_t k = 0; k < motions[n].joint_count; k++)
      nsvcd__merge_joint(&motions[n], k, &all, &out, points);
  }
  *merged = out;
  return NSVCD_OK;
}

// ------------------------------------------------------------------------------------- robot/looks
// In: a motion of the joints. Out: does it seem free? An opinion, by nsvcd_look, at places on it.
//
// 16 configurations are looked at together, spread over the motion, the first batches far apart.
// Links are placed in all of them side by side, in float, with each joint's axis along z. A pair is
// looked at where the boxes about its parts overlap, and the one that met last comes first.

// radians or metres between the places of a motion
#define NSVCD__LOOK_STEP 0.05
// metres by which a pair's margin is less at each look, where the ends, proven free, seem to meet
#define NSVCD__LOOK_CUT 1e-3f

// A frame in that of a link: a matrix, row-major, and an offset.
typedef struct nsvcd__look_frame {
  float turn[9], offset[3];
} nsvcd__look_frame;

// A part, as looks have it.
typedef struct nsvcd__look_part {
  nsvcd__look_frame frame;
  // a sphere about it, in its link
  float centre[3], radius;
  // of the places at hand, or of a part that rests
  float low[3], high[3];
  // metres: the error of its balls; 0: it has none, or is a box
  float error;
  // where its places are, if it moves; are they those of the batch at hand?
  nsvcd_places *places;
  int is_placed;
} nsvcd__look_part;

typedef struct nsvcd__looker {
  const nsvcd_checker *checker;
  // whose `stop` ends looks
  const nsvcd_check_options *options;
  // (F): each joint in the link that it is on, turned so that axes are along z
  nsvcd__look_frame *joints;
  // (F, 16): configurations that are looked at
  double (*places)[NSVCD_LOOKS];
  // (F + 1)
  nsvcd_places *links;
  // (B)
  nsvcd__look_part *parts;
  // (P): metres, as nsvcd_look_options has it
  float *margins;
  // of a part that rests
  nsvcd_places resting;
  // the pair that met last; scene->pair_count: none yet
  size_t last;
  // motions that were looked at
  size_t count;
} nsvcd__looker;

// ---- where everything is

// A rotation that takes z to an axis.
static nsvcd__dmat3 nsvcd__look_axes(nsvcd__d3 axis) {
  const nsvcd__d3 helper = fabs(axis.x) < 0.6 ? nsvcd__d3_of(1, 0, 0) : nsvcd__d3_of(0, 1, 0);
  const nsvcd__d3 x = nsvcd__d3_unit(nsvcd__d3_cross(helper, axis), helper);
  const nsvcd__d3 y = nsvcd__d3_cross(axis, x);
  const nsvcd__dmat3 out = {nsvcd__d3_of(x.x, y.x, axis.x), nsvcd__d3_of(x.y, y.y, axis.y),
                            nsvcd__d3_of(x.z, y.z, axis.z)};
  return out;
}

// A frame of a link as its turned axes see it, with axes of its own. before: of the link.
static nsvcd__look_frame nsvcd__look_frame_of(const nsvcd__dmat3 *before,
                                              const nsvcd__dpose *frame,
                                              const nsvcd__dmat3 *own) {
  const nsvcd__dmat3 turn = nsvcd__dmat3_of(frame->rotation);
  const nsvcd__d3 *rows[3] = {&before->x, &before->y, &before->z};
  const nsvcd__d3 *of_turn[3] = {&turn.x, &turn.y, &turn.z};
  nsvcd__look_frame out;
  memset(&out, 0, sizeof out);
  for (size_t i = 0; i < 3; i++) {
    // row i of the transpose of `before`, times the matrix
    nsvcd__d3 row = {0, 0, 0};
    double offset = 0;
    for (size_t k = 0; k < 3; k++) {
      const double factor = nsvcd__d3_axis(*rows[k], i);
      row = nsvcd__d3_fma(factor, *of_turn[k], row);
      offset += factor * nsvcd__d3_axis(frame->position, k);
    }
    out.offset[i] = (float)offset;
    for (size_t k = 0; k < 3; k++)
      out.turn[3 * i + k] =
          (float)(row.x * nsvcd__d3_axis(own->x, k) + row.y * nsvcd__d3_axis(own->y, k) +
                  row.z * nsvcd__d3_axis(own->z, k));
  }
  return out;
}

// out = x rows[0] + y rows[1] + z rows[2] + base, of 16 numbers each. In a copy of its own, so that
// compilers need not ask whether rows overlap, and vectorize it.
static void nsvcd__look_mix(const float (*rows)[NSVCD_LOOKS], float x, float y, float z,
                            const float *base, float *out) {
  float sums[NSVCD_LOOKS];
  for (size_t l = 0; l < NSVCD_LOOKS; l++)
    sums[l] = rows[0][l] * x + rows[1][l] * y + rows[2][l] * z + base[l];
  memcpy(out, sums, sizeof sums);
}

// A frame in 16 places of a link.
static void nsvcd__look_carry(const nsvcd_places *link, const nsvcd__look_frame *frame,
                              nsvcd_places *out) {
  static const float zeros[NSVCD_LOOKS] = {0};
  const float *turn = frame->turn;
  const float *offset = frame->offset;
  for (size_t i = 0; i < 3; i++) {
    const float(*from)[NSVCD_LOOKS] = (const float(*)[NSVCD_LOOKS])(link->rotation + 3 * i);
    float *at = out->position[i];
    for (size_t k = 0; k < 3; k++) {
      float *row = out->rotation[3 * i + k];
      nsvcd__look_mix(from, turn[k], turn[3 + k], turn[6 + k], zeros, row);
    }
    nsvcd__look_mix(from, offset[0], offset[1], offset[2], link->position[i], at);
  }
}

// Sines and cosines of 16 angles, within 1e-6.
static void nsvcd__look_angles(const double *angles, float *sines, float *cosines) {
  for (size_t l = 0; l < NSVCD_LOOKS; l++) {
    const double turns = angles[l] * 0.6366197723675814;
    const int quarter = (int)(turns < 0 ? turns - 0.5 : turns + 0.5);
    const float x = (float)(angles[l] - 1.5707963267948966 * quarter);
    const float y = x * x;
    const float s = x + x * y * (-1.6666655e-1f + y * (8.3321609e-3f - y * 1.9515296e-4f));
    const float c =
        1 - 0.5f * y + y * y * (4.1666646e-2f + y * (-1.3887316e-3f + y * 2.4433157e-5f));
    const int swaps = quarter & 1;
    const float sine = swaps ? c : s;
    const float cosine = swaps ? s : c;
    sines[l] = quarter & 2 ? -sine : sine;
    cosines[l] = (quarter + 1) & 2 ? -cosine : cosine;
  }
}

// Places the links. joints: (F, 16).
static void nsvcd__look_place_links(nsvcd__looker *k, double (*joints)[NSVCD_LOOKS]) {
  const nsvcd_scene *scene = k->checker->scene;
  for (size_t j = 0; j < scene->joint_count; j++) {
    nsvcd_places *link = &k->links[j + 1];
    float sines[NSVCD_LOOKS], cosines[NSVCD_LOOKS];
    nsvcd__look_carry(&k->links[scene->joints[j].parent], &k->joints[j], link);
    if (scene->joints[j].kind == NSVCD_JOINT_PRISMATIC) {
      for (size_t i = 0; i < 3; i++)
        for (size_t l = 0; l < NSVCD_LOOKS; l++)
          link->position[i][l] += (float)joints[j][l] * link->rotation[3 * i + 2][l];
      continue;
    }
    nsvcd__look_angles(joints[j], sines, cosines);
    for (size_t i = 0; i < 3; i++) {
      float *x = link->rotation[3 * i];
      float *y = link->rotation[3 * i + 1];
      float turned[2][NSVCD_LOOKS];
      for (size_t l = 0; l < NSVCD_LOOKS; l++) {
        turned[0][l] = cosines[l] * x[l] + sines[l] * y[l];
        turned[1][l] = cosines[l] * y[l] - sines[l] * x[l];
      }
      memcpy(x, turned[0], sizeof turned[0]);
      memcpy(y, turned[1], sizeof turned[1]);
    }
  }
  for (size_t n = 0; n < scene->part_count; n++) {
    nsvcd__look_part *part = &k->parts[n];
    const nsvcd_places *link = &k->links[scene->parts[n].link];
    if (!part->places) continue;
    part->is_placed = 0;
    for (size_t i = 0; i < 3; i++) {
      const float(*from)[NSVCD_LOOKS] = (const float(*)[NSVCD_LOOKS])(link->rotation + 3 * i);
      const float *centre = part->centre;
      float x[NSVCD_LOOKS];
      nsvcd__look_mix(from, centre[0], centre[1], centre[2], link->position[i], x);
      float low = x[0];
      float high = x[0];
      for (size_t l = 1; l < NSVCD_LOOKS; l++) {
        low = x[l] < low ? x[l] : low;
        high = x[l] > high ? x[l] : high;
      }
      part->low[i] = low - part->radius;
      part->high[i] = high + part->radius;
    }
  }
}

// ---- a looker

// Takes a looker's arrays from a workspace, or only counts them.
static void nsvcd__looker_take(const nsvcd_scene *scene, char *base, uint64_t *used,
                               nsvcd__looker *k) {
  const size_t pairs = scene->pair_count;
  k->joints = NSVCD__TAKE_ROWS(nsvcd__look_frame, scene->joint_count, base, used);
  k->places = (double(*)[NSVCD_LOOKS])nsvcd__take(base, used, scene->joint_count,
                                                  NSVCD_LOOKS * sizeof(double));
  k->links = NSVCD__TAKE_ROWS(nsvcd_places, scene->joint_count + 1, base, used);
  k->parts = NSVCD__TAKE_ROWS(nsvcd__look_part, scene->part_count, base, used);
  k->margins = NSVCD__TAKE_ROWS(float, pairs, base, used);
  if (base) memset(k->parts, 0, scene->part_count * sizeof *k->parts);
  for (size_t n = 0; n < scene->part_count; n++) {
    if (!scene->parts[n].link) continue;
    nsvcd_places *places = NSVCD__TAKE_ROWS(nsvcd_places, 1, base, used);
    if (base) k->parts[n].places = places;
  }
}

static void nsvcd__identity_places(nsvcd_places *places) {
  memset(places, 0, sizeof *places);
  for (size_t l = 0; l < NSVCD_LOOKS; l++)
    for (size_t i = 0; i < 3; i++) places->rotation[4 * i][l] = 1;
}

// The axes of a link: those of the joint that carries it; of the world, its own.
static nsvcd__dmat3 nsvcd__look_axes_of(const nsvcd_checker *c, size_t link) {
  const nsvcd__dmat3 world = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return link ? nsvcd__look_axes(c->links[link - 1].axis) : world;
}

// Fills in a looker whose arrays are taken.
static void nsvcd__looker_begin(nsvcd_checker *c, const nsvcd_check_options *options,
                                nsvcd__looker *k) {
  const nsvcd_scene *scene = c->scene;
  const nsvcd__dmat3 ones = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  k->checker = c;
  k->options = options;
  k->last = scene->pair_count;
  nsvcd__identity_places(&k->links[0]);
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd__dmat3 before = nsvcd__look_axes_of(c, scene->joints[j].parent);
    const nsvcd__dmat3 own = nsvcd__look_axes_of(c, j + 1);
    k->joints[j] = nsvcd__look_frame_of(&before, &c->links[j].origin, &own);
  }
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd__member *m = &c->members[n];
    nsvcd__look_part *part = &k->parts[n];
    const nsvcd__dmat3 before = nsvcd__look_axes_of(c, scene->parts[n].link);
    const nsvcd__dpose centre = {{0, 0, 0, 1}, m->centre};
    const nsvcd__look_frame at = nsvcd__look_frame_of(&before, &centre, &ones);
    part->frame = nsvcd__look_frame_of(&before, &m->frame, &ones);
    memcpy(part->centre, at.offset, sizeof part->centre);
    part->radius = 1.00001f * (float)(m->radius + m->round);
    part->error = (float)m->ball_error;
    nsvcd__f3_store(nsvcd__f3_round(m->bounds.low), part->low);
    nsvcd__f3_store(nsvcd__f3_round(m->bounds.high), part->high);
  }
}

// Are there balls about all that moves? Else looks would find too little free.
static int nsvcd__can_look(const nsvcd_checker *c) {
  int can = c->scene->pair_count > 0;
  for (size_t n = 0; n < c->scene->part_count; n++)
    can &= !c->scene->parts[n].link || c->members[n].balls > 0;
  return can;
}

// ---- looks

static nsvcd_looked nsvcd__look_at_part(nsvcd__looker *k, size_t n) {
  const nsvcd_part *part = &k->checker->scene->parts[n];
  nsvcd__look_part *seen = &k->parts[n];
  nsvcd_places *places = seen->places ? seen->places : &k->resting;
  const nsvcd_looked out = {part->body, part->scale, places};
  if (!seen->places || !seen->is_placed) {
    nsvcd__look_carry(&k->links[part->link], &seen->frame, places);
    seen->is_placed = 1;
  }
  return out;
}

// Does a pair seem to meet in one of the places at hand?
static int nsvcd__pair_seems_to_meet(nsvcd__looker *k, size_t pair) {
  const nsvcd_body_pair *parts = &k->checker->scene->pairs[pair];
  const nsvcd__look_part *a = &k->parts[parts->a];
  const nsvcd__look_part *b = &k->parts[parts->b];
  const nsvcd_look_options options = {k->margins[pair], 1};
  uint32_t met = 0;
  for (size_t i = 0; i < 3; i++) {
    if (a->low[i] - options.margin > b->high[i] || b->low[i] - options.margin > a->high[i])
      return 0;
  }
  const nsvcd_looked first = nsvcd__look_at_part(k, parts->a);
  const nsvcd_looked second = nsvcd__look_at_part(k, parts->b);
  // what cannot be looked at seems to meet
  if (nsvcd_look(&first, &second, &options, &met)) return 1;
  return met != 0;
}

// Does anything seem to meet in 16 configurations? joints: (F, 16).
static int nsvcd__seems_to_meet(nsvcd__looker *k, double (*joints)[NSVCD_LOOKS]) {
  const size_t pairs = k->checker->scene->pair_count;
  nsvcd__look_place_links(k, joints);
  if (k->last < pairs && nsvcd__pair_seems_to_meet(k, k->last)) return 1;
  for (size_t n = 0; n < pairs; n++) {
    if (n == k->last || !nsvcd__pair_seems_to_meet(k, n)) continue;
    k->last = n;
    return 1;
  }
  return 0;
}

// Where the joints are in 16 places of a motion, at fractions of its time: (n + l batches) / (16
// batches).
static void nsvcd__look_joints(const nsvcd_joint_motion *m, size_t joints, size_t n,
                               size_t batches, double (*out)[NSVCD_LOOKS]) {
  const double first = nsvcd__piece_start(m, 0);
  const double whole = nsvcd__piece_start(m, m->pieces) - first;
  const double all = (double)(batches * NSVCD_LOOKS);
  double at[NSVCD_MAX_JOINTS];
  for (size_t j = 0; j < joints && m->pieces == 1 && m->degree == 1; j++) {
    const double from = m->points[j];
    const double step = (m->points[joints + j] - from) / all;
    for (size_t l = 0; l < NSVCD_LOOKS; l++)
      out[j][l] = from + step * (double)(int)(n + l * batches);
  }
  for (size_t l = 0; l < NSVCD_LOOKS && (m->pieces > 1 || m->degree > 1); l++) {
    const double time = first + whole * (double)(n + l * batches) / all;
    nsvcd__joints_at_time(m, joints, time, at, NULL);
    for (size_t j = 0; j < joints; j++) out[j][l] = at[j];
  }
}

static int nsvcd__looks_end(const nsvcd__looker *k) {
  return k->options->stop && k->options->stop(k->options->user);
}

// Does a motion seem free? It begins where it is known to be, and is within the limits.
static int nsvcd__seems_free(nsvcd__looker *k, const nsvcd_joint_motion *m) {
  const size_t joints = k->checker->scene->joint_count;
  const size_t rows = m->pieces * m->degree;
  double length = 0;
  k->count++;
  for (size_t n = 0; n < rows; n++) {
    const double *from = m->points + n * joints;
    length += sqrt(nsvcd__distance2(from, from + joints, joints));
  }
  const double wanted = length / (NSVCD__LOOK_STEP * NSVCD_LOOKS);
  const size_t batches = wanted < 1 ? 1 : (size_t)nsvcd__min(ceil(wanted), 4096);
  size_t stride = 1;
  while (2 * stride <= batches) stride *= 2;
  // batch n has the places n, n + batches, ... of all; the greater steps first
  for (; stride > 0; stride /= 2) {
    for (size_t n = stride; n <= batches; n += 2 * stride) {
      if (nsvcd__looks_end(k)) return 0;
      nsvcd__look_joints(m, joints, n, batches, k->places);
      if (nsvcd__seems_to_meet(k, k->places)) return 0;
    }
  }
  return 1;
}

// Sets the margins of all pairs. Balls about two parts are taken without their errors, so that no
// meeting is invented; about one, less by a fraction of them. clearance: beside the scene's.
static void nsvcd__set_margins(nsvcd__looker *k, float clearance, float fraction) {
  const nsvcd_scene *scene = k->checker->scene;
  for (size_t n = 0; n < scene->pair_count; n++) {
    const float a = k->parts[scene->pairs[n].a].error;
    const float b = k->parts[scene->pairs[n].b].error;
    const float kept = clearance + (scene->clearances ? scene->clearances[n] : 0);
    k->margins[n] = kept - (a > 0 && b > 0 ? 1 : fraction) * (a + b);
  }
}

// Lessens margins until nothing seems to meet in a configuration that is proven free.
static void nsvcd__look_past(nsvcd__looker *k, const double *at) {
  for (size_t j = 0; j < k->checker->scene->joint_count; j++)
    for (size_t l = 0; l < NSVCD_LOOKS; l++) k->places[j][l] = at[j];
  while (!nsvcd__looks_end(k) && nsvcd__seems_to_meet(k, k->places) &&
         k->margins[k->last] > -1)
    k->margins[k->last] -= NSVCD__LOOK_CUT;
}

// ------------------------------------------------------------------------------------ robot/proofs
// In: a pair of parts, a motion of the joints, and their meshes' trees. Out: a certificate that the
// two never meet, as the joints move them.
//
// THE CHORDS. Two parts are seen from the last link that carries both, the base. Let x in [0,1] be
// the fraction of an interval of a piece that has gone by, V_j and A_j bounds of |q_j'| and |q_j''|
// by x, and L_j one of the distance of a point y from joint j: the sum of what stands between them.
// Of a joint that slides L_j is 1. Then
//   |y''| <= sum over j of A_j L_j + V_j (2 sum over outer k of V_k L_k + V_j L_j)
// the second term only for joints that turn, and y leaves its chord by an eighth of it at most. The
// bound of robot/deviation.h, from where the links are, is closer; a checker can compute this one
// again in a few lines. Source: this library.

#ifdef NEURALSVCD_CERTIFY_H
// A part, as its motion model sees it.
typedef struct nsvcd__carried {
  const nsvcd_checker *checker;
  nsvcd_joint_motion motion;
  size_t part;
  // the link that it is seen from
  size_t base;
} nsvcd__carried;

// The time in [0,1] at which a piece begins.
static double nsvcd__keyframe_of(const nsvcd_joint_motion *m, size_t piece) {
  const double first = nsvcd__piece_start(m, 0);
  const double whole = nsvcd__piece_start(m, m->pieces) - first;
  return nsvcd__stored((nsvcd__piece_start(m, piece) - first) / whole);
}

// The piece that a time in [0,1] is in.
static size_t nsvcd__keyframe_before(const nsvcd_joint_motion *m, double t) {
  size_t low = 0;
  size_t high = m->pieces;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(nsvcd__keyframe_of(m, middle) <= t ? &low : &high) = middle;
  }
  return low;
}

// The control points of a joint's curve from one time of [0,1] to another, both in a piece. Returns
// a bound of their error, and of that of their differences as the deviation has them, and a
// hundredth more: see ROUNDINGS of examples/verify/nsvcd_verify_robot.h.
static double nsvcd__curve_of(const nsvcd__carried *c, size_t joint, double t0, double t1,
                              double *p) {
  const nsvcd_joint_motion *m = &c->motion;
  const size_t piece = nsvcd__keyframe_before(m, 0.5 * (t0 + t1));
  const double start = nsvcd__keyframe_of(m, piece);
  const double whole = nsvcd__keyframe_of(m, piece + 1) - start;
  const double from = nsvcd__max((t0 - start) / whole, 0);
  const double to = nsvcd__min((t1 - start) / whole, 1);
  double most = 0;
  nsvcd__joint_points(m, piece, c->checker->scene->joint_count, joint, p);
  for (size_t i = 0; i <= m->degree; i++) most = nsvcd__max(most, fabs(p[i]));
  nsvcd__cut_curve(p, m->degree, from, to);
  return 5.05e-13 * most;
}

static nsvcd_pose64 nsvcd__carried_pose(const void *motion, double t) {
  const nsvcd__carried *c = (const nsvcd__carried *)motion;
  const nsvcd_scene *scene = c->checker->scene;
  nsvcd__dpose at = c->checker->members[c->part].frame;
  for (size_t link = scene->parts[c->part].link; link != c->base;
       link = scene->joints[link - 1].parent) {
    double q[NSVCD_MAX_DEGREE + 1];
    (void)nsvcd__curve_of(c, link - 1, t, t, q);
    const nsvcd__dpose carrier = nsvcd__joint_frame(c->checker, link - 1, q[0]);
    at = nsvcd__dpose_mul(&carrier, &at);
  }
  const nsvcd_pose64 out = {{at.position.x, at.position.y, at.position.z},
                            {at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w}};
  return out;
}

static double nsvcd__carried_next(const void *motion, double t) {
  const nsvcd_joint_motion *m = &((const nsvcd__carried *)motion)->motion;
  return nsvcd__keyframe_of(m, nsvcd__keyframe_before(m, t) + 1);
}

// THE CHORDS of the banner. Each sum is a pair: `base` does not depend on the distance from the
// part's origin, `per_metre` goes with it.
static nsvcd_deviation nsvcd__carried_deviation(const void *motion, double t0, double t1) {
  const nsvcd__carried *c = (const nsvcd__carried *)motion;
  const nsvcd_scene *scene = c->checker->scene;
  const size_t degree = c->motion.degree;
  const double n = (double)degree;
  double between = nsvcd__d3_norm(c->checker->members[c->part].frame.position);
  nsvcd_deviation outer, out;
  memset(&outer, 0, sizeof outer);
  memset(&out, 0, sizeof out);
  for (size_t link = scene->parts[c->part].link; link != c->base;
       link = scene->joints[link - 1].parent) {
    const int slides = nsvcd__slides(c->checker, link - 1);
    const double per_metre = slides ? 0 : 1;
    const double base = slides ? 1 : between;
    double p[NSVCD_MAX_DEGREE + 1];
    double most = 0;
    double speed = 0;
    double bend = 0;
    const double error = nsvcd__curve_of(c, link - 1, t0, t1, p);
    for (size_t i = 0; i <= degree; i++) {
      most = nsvcd__max(most, fabs(p[i]));
      if (i >= 1) speed = nsvcd__max(speed, n * fabs(p[i] - p[i - 1]));
      if (i >= 2) bend = nsvcd__max(bend, n * (n - 1) * fabs(p[i] - 2 * p[i - 1] + p[i - 2]));
    }
    most += error;
    speed += error;
    bend += error;
    const double own = slides ? 0 : speed;
    out.base += bend * base + own * (2 * outer.base + own * base);
    out.per_metre += bend * per_metre + own * (2 * outer.per_metre + own * per_metre);
    outer.base += speed * base;
    outer.per_metre += speed * per_metre;
    const nsvcd__link *carrier = &c->checker->links[link - 1];
    between += nsvcd__d3_norm(carrier->origin.position) + (slides ? most : 0);
  }
  out.base *= 0.1250001;
  out.per_metre *= 0.1250001;
  return out;
}

// The lower half of a double first, whatever the machine's order.
static uint32_t nsvcd__digest_double(uint32_t digest, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  const uint32_t halves[2] = {(uint32_t)bits, (uint32_t)(bits >> 32)};
  return nsvcd__digest(digest, halves, 2);
}

// With a digest of what carries the part, and as `extent` a bound of all lengths between it and the
// base.
static nsvcd_motion_model nsvcd__carried_model(const nsvcd__carried *c) {
  const nsvcd_scene *scene = c->checker->scene;
  const nsvcd_part *part = &scene->parts[c->part];
  const nsvcd_joint_motion *m = &c->motion;
  const float scale = part->scale > 0 ? part->scale : 1;
  double extent = nsvcd__d3_norm(c->checker->members[c->part].frame.position);
  uint32_t d = nsvcd__digest((uint32_t)c->base, part->pose.position, 7);
  d = nsvcd__digest(d, &scale, 1);
  for (size_t link = part->link; link != c->base; link = scene->joints[link - 1].parent) {
    const nsvcd_joint *joint = &scene->joints[link - 1];
    const uint32_t slides = joint->kind == NSVCD_JOINT_PRISMATIC;
    double most = 0;
    d = nsvcd__digest(d + slides, joint->origin.position, 7);
    d = nsvcd__digest(d + (uint32_t)link, joint->axis, 3);
    for (size_t i = 0; i <= m->pieces * m->degree; i++) {
      const double value = m->points[i * scene->joint_count + link - 1];
      d = nsvcd__digest_double(d, value);
      most = nsvcd__max(most, fabs(value));
    }
    const nsvcd__link *carrier = &c->checker->links[link - 1];
    extent += nsvcd__d3_norm(carrier->origin.position) + (slides ? most : 0);
  }
  d += (uint32_t)m->degree;
  for (size_t i = 0; i <= m->pieces; i++)
    d = nsvcd__digest_double(d, nsvcd__piece_start(m, i));
  const nsvcd_motion_model model = {(double)scale,
                                    nsvcd__carried_pose,
                                    nsvcd__carried_next,
                                    nsvcd__carried_deviation,
                                    c,
                                    extent,
                                    d};
  return model;
}

// Are there pieces, and has a double digits left for their angles and times?
static int nsvcd__is_provable(const nsvcd_checker *c, const nsvcd_joint_motion *m) {
  const size_t joints = c->scene->joint_count;
  if (m->pieces < 1 || m->pieces > NSVCD_MAX_POSES) return 0;
  for (size_t i = 0; i <= m->pieces * m->degree; i++) {
    const size_t piece = i > 0 ? (i - 1) / m->degree : 0;
    const double whole = nsvcd__keyframe_of(m, piece + 1) - nsvcd__keyframe_of(m, piece);
    if (!(whole >= 1.001e-9)) return 0;
    for (size_t j = 0; j < joints; j++) {
      const double *value = &m->points[i * joints + j];
      const double speed = i > 0 ? (double)m->degree * fabs(*value - *(value - joints)) : 0;
      if (!nsvcd__slides(c, j) && !(fabs(*value) <= 250)) return 0;
      if (!(speed <= 0.999e5 * whole)) return 0;
    }
  }
  return 1;
}

NSVCDDEF size_t nsvcd_certify_pair_workspace_size(const nsvcd_joint_motion *motion,
                                                  const nsvcd_tree *a, const nsvcd_tree *b) {
  return motion ? nsvcd_certify_models_workspace_size(motion->pieces + 1, a, b) : 0;
}

NSVCDDEF nsvcd_result nsvcd_certify_pair(const nsvcd_checker *checker,
                                         const nsvcd_joint_motion *motion, size_t pair,
                                         float clearance, const nsvcd_tree *a,
                                         const nsvcd_tree *b,
                                         const nsvcd_certify_options *options, void *workspace,
                                         size_t workspace_size, uint8_t *bytes,
                                         size_t capacity, nsvcd_certificate *made) {
  if (!checker || !motion || !a || !b || !made || (capacity > 0 && !bytes))
    return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  if (!motion->points) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result result = nsvcd__motion_check(scene, motion);
  if (result) return result;
  if (pair >= scene->pair_count) return NSVCD_ERROR_PAIR;
  if (!nsvcd__is_provable(checker, motion)) return NSVCD_ERROR_TURN;
  const nsvcd_body_pair *parts = &scene->pairs[pair];
  const size_t base =
      nsvcd__common_link(scene, scene->parts[parts->a].link, scene->parts[parts->b].link);
  const nsvcd__carried carried[2] = {{checker, *motion, parts->a, base},
                                     {checker, *motion, parts->b, base}};
  const nsvcd_motion_model models[2] = {nsvcd__carried_model(&carried[0]),
                                        nsvcd__carried_model(&carried[1])};
  return nsvcd_certify_models(models, motion->pieces + 1, clearance, a, b, options, workspace,
                              workspace_size, bytes, capacity, made);
}
#endif  // NEURALSVCD_CERTIFY_H

// --------------------------------------------------------------------------------------- robot/rrt
// In: configurations. Out: a tree of them, and the node that is nearest to another configuration.
//
// Distances are Euclidean, radians and metres alike. The nearest node is found by a k-d tree that
// grows: a leaf with too many nodes is cut half way along the joint in which they are widest apart.

// nodes of a leaf, at most
#define NSVCD__LEAF 8

// A cell of the k-d tree.
typedef struct nsvcd__cell {
  // where it is cut; unused in a leaf
  double at;
  // by which; NSVCD_MAX_JOINTS: a leaf
  uint32_t joint;
  // its halves, one after another; of a leaf: its nodes, by `next`
  uint32_t first, count;
} nsvcd__cell;

// What is known of a node: the edge from its parent is proven; it is not in the tree any more; an
// edge from here that seemed free was not.
enum { NSVCD__NODE_PROVEN = 1, NSVCD__NODE_CUT = 2, NSVCD__NODE_DOUBTED = 4 };

typedef struct nsvcd__rrt {
  size_t joints, count, cell_count;
  // (nodes, F)
  double *points;
  // (nodes): of a root, itself
  uint32_t *parents;
  // (nodes): NSVCD__NODE_*
  uint8_t *marks;
  // (nodes): in a leaf
  uint32_t *next;
  // (2 nodes)
  nsvcd__cell *cells;
} nsvcd__rrt;

static const nsvcd__cell nsvcd__empty_leaf = {0, NSVCD_MAX_JOINTS, 0, 0};

static double *nsvcd__node_at(const nsvcd__rrt *t, size_t node) {
  return t->points + node * t->joints;
}

// Cuts a leaf, unless all its points are the same.
static void nsvcd__cut_leaf(nsvcd__rrt *t, size_t index) {
  nsvcd__cell *cell = &t->cells[index];
  size_t widest = 0;
  double width = 0;
  double middle = 0;
  for (size_t j = 0; j < t->joints; j++) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      low = nsvcd__min(low, nsvcd__node_at(t, node)[j]);
      high = nsvcd__max(high, nsvcd__node_at(t, node)[j]);
    }
    if (!(high - low > width)) continue;
    widest = j;
    width = high - low;
    middle = 0.5 * (low + high);
  }
  if (!(width > 0)) return;
  nsvcd__cell *halves = &t->cells[t->cell_count];
  halves[0] = halves[1] = nsvcd__empty_leaf;
  t->cell_count += 2;
  uint32_t node = cell->first;
  for (uint32_t n = 0; n < cell->count; n++) {
    const uint32_t following = t->next[node];
    nsvcd__cell *half = &halves[nsvcd__node_at(t, node)[widest] > middle];
    t->next[node] = half->first;
    half->first = node;
    half->count++;
    node = following;
  }
  cell->joint = (uint32_t)widest;
  cell->at = middle;
  cell->first = (uint32_t)(halves - t->cells);
}

// parent: t->count of a root. Returns the node.
static size_t nsvcd__tree_add(nsvcd__rrt *t, const double *at, size_t parent) {
  const size_t node = t->count++;
  size_t index = 0;
  memcpy(nsvcd__node_at(t, node), at, t->joints * sizeof *at);
  t->parents[node] = (uint32_t)parent;
  t->marks[node] = 0;
  if (t->cell_count == 0) t->cells[t->cell_count++] = nsvcd__empty_leaf;
  while (t->cells[index].joint < NSVCD_MAX_JOINTS)
    index = t->cells[index].first + (at[t->cells[index].joint] > t->cells[index].at);
  t->next[node] = t->cells[index].first;
  t->cells[index].first = (uint32_t)node;
  if (++t->cells[index].count > NSVCD__LEAF) nsvcd__cut_leaf(t, index);
  return node;
}

// Cuts off a node, and all that hangs on it. A parent comes before its children.
static void nsvcd__tree_cut(nsvcd__rrt *t, size_t node) {
  t->marks[node] |= NSVCD__NODE_CUT;
  for (size_t n = node + 1; n < t->count; n++)
    if (t->marks[t->parents[n]] & NSVCD__NODE_CUT) t->marks[n] |= NSVCD__NODE_CUT;
}

// Looks in a cell for a node nearer than *best, a squared distance. off: from the point to the
// cell, joint by joint, and its square.
static void nsvcd__nearest_in(const nsvcd__rrt *t, size_t index, const double *at, double *off,
                              double off2, size_t *nearest, double *best) {
  const nsvcd__cell *cell = &t->cells[index];
  if (!(off2 < *best)) return;
  if (cell->joint == NSVCD_MAX_JOINTS) {
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      const double distance2 = nsvcd__distance2(nsvcd__node_at(t, node), at, t->joints);
      if (!(distance2 < *best) || t->marks[node] & NSVCD__NODE_CUT) continue;
      *best = distance2;
      *nearest = node;
    }
    return;
  }
  const double side = at[cell->joint] - cell->at;
  const double was = off[cell->joint];
  nsvcd__nearest_in(t, cell->first + (side > 0), at, off, off2, nearest, best);
  off[cell->joint] = side;
  nsvcd__nearest_in(t, cell->first + !(side > 0), at, off, off2 + side * side - was * was,
                    nearest, best);
  off[cell->joint] = was;
}

// The node nearest to a configuration, of a tree that has one.
static size_t nsvcd__tree_nearest(const nsvcd__rrt *t, const double *at) {
  double off[NSVCD_MAX_JOINTS] = {0};
  double best = HUGE_VAL;
  size_t nearest = 0;
  nsvcd__nearest_in(t, 0, at, off, 0, &nearest, &best);
  return nearest;
}

// ---------------------------------------------------------------------------- robot/configurations
// In: a robot in one configuration. Out: pairs that are near each other, and how their distances
// change with the joints; the nearest configuration that is free; which pairs can meet.

// defaults
#define NSVCD__MAX_DISTANCE 0.05f
#define NSVCD__DISTANCE_TO 2e-5f
#define NSVCD__MAX_DEPTH 0.02f
#define NSVCD__FARTHEST_FREE 0.5
#define NSVCD__PAIR_DRAWS 64
// of `max_depth`: the first slop that is tried; and how often a push-out is halved
#define NSVCD__LEAST_SLOP 0.015625f
#define NSVCD__DEPTH_HALVINGS 12
// of the depth: how far parts are pushed out to see which faces separate last
#define NSVCD__DEPTH_BEYOND 1.01
// the least cosine between a push-out and the normal for which there is a slope
#define NSVCD__LEAST_RATE 0.1
// metres that the nearest free configuration has beside the clearance, so that a route can begin
// there
#define NSVCD__FREE_ROOM 5e-4f
// and the share of a cone's angle that it keeps to
#define NSVCD__FREE_CONE 0.95
// spheres about the joints on which configurations are drawn, and how many on each
#define NSVCD__FREE_SPHERES 8
#define NSVCD__FREE_DRAWS 64
// how much nearer than the best the next one is drawn; halvings of the line back
#define NSVCD__FREE_NEARER 0.9
#define NSVCD__FREE_HALVINGS 10

static nsvcd_result nsvcd__check_joints(const nsvcd_checker *c, const double *joints) {
  if (!c || !joints) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__are_numbers(joints, c->scene->joint_count)) return NSVCD_ERROR_VALUE;
  return nsvcd__follows(c->scene, 1, joints) ? NSVCD_OK : NSVCD_ERROR_MIMIC;
}

// ---- proximities

// Adds to the slope how fast a point of a part moves along a direction by each joint and those that
// it drives, times `sign`. The point and the direction are in the local frame.
static void nsvcd__slope_add(const nsvcd_checker *c, size_t part, const nsvcd__local *local,
                             nsvcd__d3 at, nsvcd__d3 along, double sign, double *slope) {
  const nsvcd__d3 point = nsvcd__dpose_apply(&local->frame, at);
  const nsvcd__d3 normal = nsvcd__dquat_rotate(local->frame.rotation, along);
  for (size_t link = c->scene->parts[part].link; link > 0;
       link = nsvcd__link_before(c, link)) {
    const nsvcd__d3 arm = nsvcd__d3_sub(point, c->at->frames[link].position);
    const nsvcd__d3 axis = c->at->axes[link - 1];
    const nsvcd__d3 speed = nsvcd__slides(c, link - 1) ? axis : nsvcd__d3_cross(axis, arm);
    slope[nsvcd__driver(c->scene, link - 1)] +=
        sign * nsvcd__rate(c->scene, link - 1) * nsvcd__d3_dot(normal, speed);
  }
}

// Asks a question with a pushed out.
static nsvcd_verdict nsvcd__ask_pushed(nsvcd_checker *c, const nsvcd_question *q,
                                       nsvcd__d3 push_out, nsvcd_answer *found) {
  nsvcd_pose pose = *q->a.poses;
  nsvcd_question pushed = *q;
  const nsvcd__d3 position = nsvcd__d3_add(nsvcd__d3_load(pose.position), push_out);
  pushed.a.poses = &pose;
  nsvcd__f3_store(nsvcd__f3_round(position), pose.position);
  return nsvcd__ask_sweep(c, &pushed, found);
}

// A push-out of a off b that separates them. Slops are tried, each four times the one before, up to
// `max_depth`; 0 where none is enough.
static nsvcd__d3 nsvcd__separating_push_out(nsvcd_checker *c, nsvcd_question q,
                                            float max_depth) {
  nsvcd_answer found;
  for (float fraction = NSVCD__LEAST_SLOP; fraction <= 1; fraction *= 4) {
    q.slop = fraction * max_depth;
    if (nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE) return nsvcd__d3_load(found.push_out);
  }
  return nsvcd__d3_of(0, 0, 0);
}

// Of parts that touch: the depth, its contact and its slope. q: asks HIT, with all errors of the
// poses as its clearance.
static void nsvcd__depth_of(nsvcd_checker *c, nsvcd_question q, const nsvcd__local *local,
                            const nsvcd_proximity_options *o, nsvcd_proximity *out) {
  const nsvcd_body_pair *pair = &c->scene->pairs[out->pair];
  const nsvcd__d3 push_out = nsvcd__separating_push_out(c, q, o->max_depth);
  const double length = nsvcd__d3_norm(push_out);
  nsvcd_answer found;
  // fractions of the push-out: they touch at the first, and are apart at the second
  double low = 0;
  double high = 1;
  if (!(length > 0)) return;
  for (size_t n = 0; n < NSVCD__DEPTH_HALVINGS; n++) {
    const double middle = 0.5 * (low + high);
    const nsvcd__d3 part = nsvcd__d3_scale(push_out, middle);
    const int is_apart = nsvcd__ask_pushed(c, &q, part, &found) == NSVCD_FREE;
    *(is_apart ? &high : &low) = middle;
  }
  // a little beyond: which faces are near?
  const double beyond = NSVCD__DEPTH_BEYOND * high + (double)o->to / length;
  q.clearance = 0;
  q.ask = NSVCD_ASK_DISTANCE;
  q.to = 0.1f * o->to;
  (void)nsvcd__ask_pushed(c, &q, nsvcd__d3_scale(push_out, beyond), &found);
  const nsvcd__d3 along = nsvcd__d3_scale(push_out, 1 / length);
  const nsvcd__d3 normal = nsvcd__d3_load(found.nearest.normal);
  const nsvcd__d3 point = nsvcd__d3_load(found.nearest.point);
  out->depth = nsvcd__above(high * length);
  out->contact = found.nearest;
  out->contact.gap = 0;
  nsvcd__f3_store(nsvcd__f3_round(along), out->contact.normal);
  nsvcd__contact_to_world(local, &out->contact);
  // a push-out separates the two faces at this fraction of its own speed
  const double rate = nsvcd__d3_dot(along, normal);
  if (!(rate > NSVCD__LEAST_RATE)) return;
  const nsvcd__d3 on_a = nsvcd__d3_fma(-high, push_out, point);
  nsvcd__slope_add(c, pair->a, local, on_a, normal, 1 / rate, out->slope);
  nsvcd__slope_add(c, pair->b, local, point, normal, -1 / rate, out->slope);
}

// The proximity of a pair in the configuration c->at. Returns 0 if it is not within max_distance.
static int nsvcd__proximity_of(nsvcd_checker *c, size_t index,
                               const nsvcd_proximity_options *o, nsvcd_proximity *out) {
  const nsvcd_body_pair *pair = &c->scene->pairs[index];
  const nsvcd__member *a = &c->members[pair->a];
  const nsvcd__member *b = &c->members[pair->b];
  nsvcd_answer found;
  const double frames_error = 2 * (a->rounding + b->rounding);
  const double max_distance = (double)o->max_distance + frames_error;
  if (nsvcd__bounds_apart(&a->bounds, &b->bounds, 1.000001 * max_distance)) return 0;
  const nsvcd__local local = nsvcd__localize_at(c, pair);
  nsvcd_question q = nsvcd__question_of(c, pair, 1, o->work);
  const double error = frames_error + local.rounding;
  q.clearance = nsvcd__above((double)o->max_distance + error);
  if (nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE) return 0;
  q.clearance = 0;
  q.ask = NSVCD_ASK_DISTANCE;
  q.to = o->to;
  memset(out, 0, sizeof *out);
  out->pair = index;
  out->verdict = nsvcd__ask_sweep(c, &q, &found);
  out->why = found.why;
  out->contact = found.nearest;
  nsvcd__contact_to_world(&local, &out->contact);
  q.ask = NSVCD_ASK_HIT;
  q.to = 0;
  if (found.verdict == NSVCD_HIT) {
    out->distance.high = nsvcd__above(error);
    out->depth = HUGE_VALF;
    // push-outs are rounded to float
    q.clearance = nsvcd__above(error + 2e-7 * (double)o->max_depth);
    if (!found.inside) nsvcd__depth_of(c, q, &local, o, out);
    return 1;
  }
  out->distance.high = nsvcd__above((double)found.distance.high + error);
  out->distance.low = (float)nsvcd__max((double)found.distance.low * (1 - 1e-7) - error, 0);
  // of both at the point on b: that on a is off it along the normal, and no turn changes that
  const nsvcd__d3 normal = nsvcd__d3_load(found.nearest.normal);
  const nsvcd__d3 point = nsvcd__d3_load(found.nearest.point);
  nsvcd__slope_add(c, pair->a, &local, point, normal, 1, out->slope);
  nsvcd__slope_add(c, pair->b, &local, point, normal, -1, out->slope);
  if (out->verdict != NSVCD_FREE || out->distance.low > 0) return 1;
  // the poses in float are free of each other: are the parts?
  q.clearance = nsvcd__above(error);
  if (nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE) return 1;
  out->verdict = NSVCD_UNDECIDED;
  out->why = NSVCD_WHY_TOO_NEAR;
  return 1;
}

NSVCDDEF nsvcd_result nsvcd_proximities(nsvcd_checker *c, const double *joints,
                                        const nsvcd_proximity_options *options,
                                        nsvcd_proximity *out, size_t capacity, size_t *count) {
  nsvcd_proximity_options o;
  size_t written = 0;
  nsvcd_result result = nsvcd__check_joints(c, joints);
  if (!result && (!count || (!out && capacity > 0))) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_length(o.max_distance) || !nsvcd__is_length(o.max_depth))
    return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__is_length(o.to)) return NSVCD_ERROR_TO;
  o.max_distance = o.max_distance > 0 ? o.max_distance : NSVCD__MAX_DISTANCE;
  o.to = o.to > 0 ? o.to : NSVCD__DISTANCE_TO;
  o.max_depth = o.max_depth > 0 ? o.max_depth : NSVCD__MAX_DEPTH;
  nsvcd__place_links(c, joints, c->at);
  nsvcd__place_sample(c, c->at, 0);
  c->result = NSVCD_OK;
  for (size_t n = 0; n < c->scene->pair_count && !c->result; n++) {
    nsvcd_proximity found;
    if (!nsvcd__proximity_of(c, n, &o, &found)) continue;
    if (written < capacity) out[written] = found;
    written++;
  }
  if (!c->result) *count = written;
  return c->result;
}

// ---- the nearest free configuration

// Is a configuration free? An error is in c->result.
static int nsvcd__is_free_at(nsvcd_checker *c, const double *joints,
                             const nsvcd_nearest_free_options *o) {
  const nsvcd_joint_motion still = {0, 0, joints, NULL};
  const nsvcd_check_options options = {o->clearance, 0, 0, o->stop, o->user, 0};
  nsvcd_check_answer answer;
  return !nsvcd_check(c, &still, &options, &answer) && nsvcd__proves_free(&answer);
}

// Moves a free configuration towards `from`, which is not free, as far as that stays free.
static void nsvcd__draw_back(nsvcd_checker *c, const double *from,
                             const nsvcd_nearest_free_options *o, double *at) {
  const size_t joints = c->scene->joint_count;
  double blocked[NSVCD_MAX_JOINTS], middle[NSVCD_MAX_JOINTS];
  memcpy(blocked, from, joints * sizeof *at);
  for (size_t n = 0; n < NSVCD__FREE_HALVINGS && !c->result; n++) {
    for (size_t j = 0; j < joints; j++) middle[j] = 0.5 * (blocked[j] + at[j]);
    nsvcd__follow(c->scene, 1, middle);
    const int is_free = nsvcd__is_free_at(c, middle, o);
    memcpy(is_free ? at : blocked, middle, joints * sizeof *at);
  }
}

// Draws on spheres about `from`, the innermost first, until a configuration is free; then on ever
// smaller ones, nearer than the best. Returns 0 if none is found.
static int nsvcd__seek_nearest_free(nsvcd_checker *c, const double *from,
                                    const nsvcd_nearest_free_options *o, double *out) {
  const size_t joints = c->scene->joint_count;
  uint64_t random = o->seed;
  double best = o->farthest;
  int is_found = 0;
  for (size_t n = 0; n < NSVCD__FREE_SPHERES * NSVCD__FREE_DRAWS && !c->result; n++) {
    const double sphere = (double)(n / NSVCD__FREE_DRAWS + 1) / NSVCD__FREE_SPHERES;
    const double radius = is_found ? NSVCD__FREE_NEARER * best : sphere * o->farthest;
    double at[NSVCD_MAX_JOINTS];
    double square = 0;
    if (o->stop && o->stop(o->user)) break;
    for (size_t j = 0; j < joints; j++) at[j] = 2 * nsvcd__random(&random) - 1;
    for (size_t j = 0; j < joints; j++) {
      at[j] = nsvcd__rate(c->scene, j) * at[nsvcd__driver(c->scene, j)];
      square += at[j] * at[j];
    }
    for (size_t j = 0; j < joints; j++) at[j] = from[j] + radius / sqrt(square) * at[j];
    nsvcd__clamp_to_limits(c->scene, at);
    if (!nsvcd__into_cones(c, NULL, NSVCD__FREE_CONE, at)) continue;
    // which may have led away
    if (nsvcd__distance2(at, from, joints) > best * best * (1 + 1e-9)) continue;
    if (!nsvcd__is_free_at(c, at, o)) continue;
    nsvcd__draw_back(c, from, o, at);
    is_found = 1;
    best = sqrt(nsvcd__distance2(at, from, joints));
    memcpy(out, at, joints * sizeof *at);
  }
  return is_found;
}

NSVCDDEF nsvcd_result nsvcd_nearest_free(nsvcd_checker *c, const double *joints,
                                         const nsvcd_nearest_free_options *options,
                                         double *out, int *is_found) {
  nsvcd_nearest_free_options o;
  double from[NSVCD_MAX_JOINTS], at[NSVCD_MAX_JOINTS];
  nsvcd_result result = nsvcd__check_joints(c, joints);
  if (!result && (!out || !is_found)) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  const size_t bytes = c->scene->joint_count * sizeof(double);
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__in_range(&o.clearance, 1, 0.5f * NSVCD_MAX_COORDINATE) || o.clearance < 0)
    return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__are_numbers(&o.farthest, 1) || o.farthest < 0) return NSVCD_ERROR_FARTHEST;
  o.farthest = o.farthest > 0 ? o.farthest : NSVCD__FARTHEST_FREE;
  memcpy(from, joints, bytes);
  nsvcd__clamp_to_limits(c->scene, from);
  memcpy(at, from, bytes);
  int is_free = nsvcd__is_free_at(c, from, &o);
  o.clearance += NSVCD__FREE_ROOM;
  if (!is_free && !c->result) is_free = nsvcd__seek_nearest_free(c, from, &o, at);
  if (c->result) return c->result;
  *is_found = is_free;
  if (is_free) memcpy(out, at, bytes);
  return NSVCD_OK;
}

// ---- pairs

// Do two parts touch in all of so many configurations, drawn within the limits?
static int nsvcd__touches_in_all(nsvcd_checker *c, const nsvcd_body_pair *pair, size_t draws,
                                 uint64_t random) {
  nsvcd_answer found;
  for (size_t n = 0; n < draws; n++) {
    double joints[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < c->scene->joint_count; j++) {
      const nsvcd_joint *joint = &c->scene->joints[j];
      const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
      const double low = is_endless ? 0 : joint->low;
      const double high = is_endless ? 6.283185307179586 : joint->high;
      joints[j] = low + (high - low) * nsvcd__random(&random);
    }
    nsvcd__follow(c->scene, 1, joints);
    nsvcd__place_links(c, joints, c->at);
    (void)nsvcd__localize_at(c, pair);
    const nsvcd_question q = nsvcd__question_of(c, pair, 1, 0);
    if (nsvcd__ask_sweep(c, &q, &found) != NSVCD_HIT) return 0;
  }
  return 1;
}

// Are two links those of one joint, and neither of them the world?
static int nsvcd__are_adjacent(const nsvcd_scene *scene, const nsvcd_body_pair *pair) {
  const size_t a = scene->parts[pair->a].link;
  const size_t b = scene->parts[pair->b].link;
  return a > 0 && b > 0 &&
         (scene->joints[a - 1].parent == b || scene->joints[b - 1].parent == a);
}

// The next pair of parts on links that differ; the first after {0, 0}. Returns 0 where there is
// none.
static int nsvcd__next_pair(const nsvcd_scene *scene, nsvcd_body_pair *pair) {
  do {
    if (++pair->b >= scene->part_count) {
      pair->a++;
      pair->b = pair->a + 1;
    }
    if (pair->b >= scene->part_count) return 0;
  } while (scene->parts[pair->a].link == scene->parts[pair->b].link);
  return 1;
}

NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *c, size_t draws, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts) {
  if (!c || !counts || (!pairs && capacity > 0)) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = c->scene;
  nsvcd_body_pair pair = {0, 0};
  nsvcd_pair_counts found = {0, 0, 0};
  size_t total = 0;
  while (nsvcd__next_pair(scene, &pair)) total++;
  if (capacity < total) return NSVCD_ERROR_WORKSPACE;
  if (!draws) draws = NSVCD__PAIR_DRAWS;
  c->result = NSVCD_OK;
  // what is to be asked from the front, what touches in all from the back
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    if (nsvcd__are_adjacent(scene, &pair)) continue;
    const int in_all = nsvcd__touches_in_all(c, &pair, draws, seed);
    if (c->result) return c->result;
    pairs[in_all ? total - ++found.touching : found.asked++] = pair;
  }
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    if (nsvcd__are_adjacent(scene, &pair)) pairs[found.asked + found.adjacent++] = pair;
  }
  // what touches, in order
  for (size_t n = 0; n < found.touching / 2; n++) {
    nsvcd_body_pair *first = &pairs[total - found.touching + n];
    nsvcd_body_pair *last = &pairs[total - 1 - n];
    pair = *first;
    *first = *last;
    *last = pair;
  }
  *counts = found;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_reparent(const nsvcd_checker *c, const double *joints, size_t part,
                                     uint32_t link, nsvcd_part *out) {
  nsvcd__links at;
  nsvcd_result result = nsvcd__check_joints(c, joints);
  if (result) return result;
  const nsvcd_scene *scene = c->scene;
  if (!out) return NSVCD_ERROR_ARGUMENT;
  if (part >= scene->part_count || link > scene->joint_count) return NSVCD_ERROR_LINK;
  nsvcd__place_links(c, joints, &at);
  const nsvcd__dpose world = nsvcd__frame_of_part(c, &at, part);
  const nsvcd__dpose frame = nsvcd__dpose_inverse_mul(&at.frames[link], &world);
  nsvcd_part moved = scene->parts[part];
  moved.link = link;
  moved.pose = nsvcd__dpose_round(&frame);
  result = nsvcd__poses_check(&moved.pose, 1);
  if (!result) *out = moved;
  return result;
}

// ---------------------------------------------------------------------------------- robot/cholesky
// In: linear equations whose matrix is positive definite. Out: their solution.

// rows of a matrix, at most
#define NSVCD__MOST_ROWS 7

// Solves m x = b, of so many rows, by Cholesky's factors, of which m keeps the lower one.
static void nsvcd__solve_rows(double m[NSVCD__MOST_ROWS][NSVCD__MOST_ROWS], const double *b,
                              size_t rows, double *x) {
  for (size_t i = 0; i < rows; i++) {
    for (size_t k = 0; k <= i; k++) {
      double sum = m[i][k];
      for (size_t l = 0; l < k; l++) sum -= m[i][l] * m[k][l];
      m[i][k] = i == k ? sqrt(nsvcd__max(sum, 1e-300)) : sum / m[k][k];
    }
  }
  for (size_t i = 0; i < rows; i++) {
    x[i] = b[i];
    for (size_t k = 0; k < i; k++) x[i] -= m[i][k] * x[k];
    x[i] /= m[i][i];
  }
  for (size_t i = rows; i-- > 0;) {
    for (size_t k = i + 1; k < rows; k++) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
}

// ------------------------------------------------------------------------------------- robot/reach
// In: a robot, a frame on one of its links, and where that is to be. Out: configurations that have
// it there.
//
// Levenberg-Marquardt, from many starts. What is made 0 is how far the tool is off its target: an
// offset, in lengths of the chain, and a rotation vector, both in the target's frame; and how far
// axes are out of their cones. What the target or a cone leaves free counts as 0.

// defaults
#define NSVCD__REACH_TOLERANCE 1e-6
#define NSVCD__REACH_APART 0.1
#define NSVCD__REACH_STARTS 200
// the search ends when so many starts have led to known solutions since the last new one
#define NSVCD__REACH_REPEATS 24
// steps from a start
#define NSVCD__REACH_STEPS 100
// the damping at first, of the squared error, up to 1; by what it changes from step to step; and
// the least, of the squares of the Jacobian
#define NSVCD__REACH_DAMPING 0.1
#define NSVCD__REACH_HARDER 8
#define NSVCD__REACH_EASIER 0.25
#define NSVCD__REACH_FLOOR 1e-13
// a start is given up after so many steps that each lessen the squared error by less than this
#define NSVCD__REACH_STALLS 6
#define NSVCD__REACH_GAIN 0.01
// the share of a cone's angle that is aimed at
#define NSVCD__REACH_CONE 0.999

// How far the tool is off its target: what is made 0 (three of the offset, three of the rotation,
// one of cones), and half of its square; metres and radians.
typedef struct nsvcd__miss {
  double residuals[NSVCD__MOST_ROWS];
  double cost, position, angle;
  // are all axes in their cones?
  int is_in;
} nsvcd__miss;

typedef struct nsvcd__reacher {
  nsvcd_checker *checker;
  const nsvcd_scene *scene;
  size_t joints;
  nsvcd_reach_problem problem;
  nsvcd_reach_options options;
  nsvcd__dpose tool, target;
  nsvcd__d3 free_axis;
  int has_free_axis;
  // the start, within the limits
  double start[NSVCD_MAX_JOINTS];
  // joints that move the tool against the target, the lower first: on the way to the tool, 1, or to
  // the target's link, -1; and leaders of such joints that are on neither, 0
  size_t chain[NSVCD_MAX_JOINTS];
  double sides[NSVCD_MAX_JOINTS];
  // of a step of each: radians, or lengths of the chain
  double units[NSVCD_MAX_JOINTS];
  size_t count;
  // metres: the lengths along the chain; and how far joints slide from the start when drawn
  double length, slide;
  uint64_t random;
  // where the links of the chain are, seen from the link where it forks; and the tool, seen from
  // the target
  nsvcd__links at;
  nsvcd__dpose there;
  nsvcd__miss miss;
  // the least cost of what does not reach the target
  double least;
  // starts that led to known solutions since the last new one
  size_t repeats;
  // of the Jacobian: one fewer where there are no cones
  size_t rows;
  // (joints of the chain): of the residuals; (F): of the last one
  double jacobian[NSVCD_MAX_JOINTS][NSVCD__MOST_ROWS], slope[NSVCD_MAX_JOINTS];
} nsvcd__reacher;

// ---- how far the tool is off

// Places the chain, and says how far off the tool is.
static void nsvcd__reach_place(nsvcd__reacher *r, const double *q) {
  const nsvcd_reach_problem *p = &r->problem;
  nsvcd__links *at = &r->at;
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    if (!(fabs(r->sides[n]) > 0)) continue;
    const nsvcd__dpose link = nsvcd__joint_frame(r->checker, j, q[j]);
    at->frames[j + 1] = nsvcd__dpose_mul(&at->frames[r->scene->joints[j].parent], &link);
    at->axes[j] = nsvcd__dquat_rotate(at->frames[j + 1].rotation, r->checker->links[j].axis);
  }
  const nsvcd__dpose tool = nsvcd__dpose_mul(&at->frames[p->link], &r->tool);
  const nsvcd__dpose target = nsvcd__dpose_mul(&at->frames[p->target_link], &r->target);
  r->there = nsvcd__dpose_inverse_mul(&target, &tool);
  const nsvcd__dquat unit = nsvcd__dquat_unit(r->there.rotation);
  nsvcd__d3 turn = nsvcd__dquat_axis(unit);
  if (r->has_free_axis) {
    turn = nsvcd__turn_between(r->free_axis, nsvcd__dquat_rotate(unit, r->free_axis));
  } else {
    const double sine = nsvcd__d3_norm(turn);
    const double angle = 2 * nsvcd__atan2(sine, fabs(unit.w));
    turn = nsvcd__d3_scale(turn, (unit.w < 0 ? -1 : 1) * (sine > 0 ? angle / sine : 2));
  }
  nsvcd__d3 off = {0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    const double x = nsvcd__d3_axis(r->there.position, k);
    const double half = (double)p->half[k];
    nsvcd__d3_set_axis(&off, k, x - nsvcd__max(-half, nsvcd__min(half, x)));
    r->miss.residuals[k] = nsvcd__d3_axis(off, k) / r->length;
    r->miss.residuals[3 + k] = nsvcd__d3_axis(turn, k);
  }
  r->miss.position = nsvcd__d3_norm(off);
  r->miss.angle = nsvcd__d3_norm(turn);
  r->miss.residuals[6] =
      nsvcd__cones_excess(r->checker, q, NSVCD__REACH_CONE, r->slope, &r->miss.is_in);
  r->miss.cost = 0;
  for (size_t k = 0; k < NSVCD__MOST_ROWS; k++)
    r->miss.cost += 0.5 * r->miss.residuals[k] * r->miss.residuals[k];
}

static int nsvcd__is_reached(const nsvcd__reacher *r) {
  return r->miss.position <= r->options.position_tolerance &&
         r->miss.angle <= r->options.angle_tolerance && r->miss.is_in;
}

// Adds what the joints that mimic one do to how the residuals change with it. All leaders are in
// the chain.
static void nsvcd__reach_add_driven(nsvcd__reacher *r) {
  for (size_t n = 0; n < r->count; n++) {
    const size_t driver = nsvcd__driver(r->scene, r->chain[n]);
    for (size_t i = 0; i < r->count && driver != r->chain[n]; i++) {
      const double rate = nsvcd__rate(r->scene, r->chain[n]) * r->units[i] / r->units[n];
      for (size_t k = 0; k < 6 && r->chain[i] == driver; k++)
        r->jacobian[i][k] += rate * r->jacobian[n][k];
    }
  }
}

// How the residuals change with each joint, which slides by lengths of the chain. Of a rotation
// vector that is exact as far as its own direction goes, which makes the gradient exact.
static void nsvcd__reach_differentiate(nsvcd__reacher *r) {
  const nsvcd_reach_problem *p = &r->problem;
  const nsvcd__dpose tool = nsvcd__dpose_mul(&r->at.frames[p->link], &r->tool);
  const nsvcd__dpose target = nsvcd__dpose_mul(&r->at.frames[p->target_link], &r->target);
  const nsvcd__dmat3 axes = nsvcd__dmat3_of(nsvcd__dquat_unit(target.rotation));
  const nsvcd__d3 spin = nsvcd__dquat_rotate(tool.rotation, r->free_axis);
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    const nsvcd__d3 axis = nsvcd__d3_scale(r->at.axes[j], r->sides[n]);
    const nsvcd__d3 arm = nsvcd__d3_sub(tool.position, r->at.frames[j + 1].position);
    nsvcd__d3 moves = nsvcd__d3_scale(nsvcd__d3_cross(axis, arm), 1 / r->length);
    nsvcd__d3 turns = axis;
    if (nsvcd__slides(r->checker, j)) {
      moves = axis;
      turns = nsvcd__d3_of(0, 0, 0);
    }
    if (r->has_free_axis) turns = nsvcd__d3_fma(-nsvcd__d3_dot(turns, spin), spin, turns);
    moves = nsvcd__dmat3_apply_transpose(&axes, moves);
    turns = nsvcd__dmat3_apply_transpose(&axes, turns);
    for (size_t k = 0; k < 3; k++) {
      const int is_free = fabs(nsvcd__d3_axis(r->there.position, k)) < (double)p->half[k];
      r->jacobian[n][k] = is_free ? 0 : nsvcd__d3_axis(moves, k);
      r->jacobian[n][3 + k] = nsvcd__d3_axis(turns, k);
    }
    r->jacobian[n][6] = r->units[n] * r->slope[j];
  }
  nsvcd__reach_add_driven(r);
}

// ---- a step

// Does the caller hold a joint of the chain, or another joint drive it?
static int nsvcd__reach_holds(const nsvcd__reacher *r, size_t n) {
  const size_t j = r->chain[n];
  return r->scene->joints[j].mimic || (r->problem.held && r->problem.held[j]);
}

// A damped step from q that keeps the limits: J^T y, where (J J^T + damping) y is minus the
// residuals. A joint that would leave its limits goes to the limit and is held there, and the
// others step anew. *expected: by how much the cost falls, if it is as the Jacobian says.
static void nsvcd__reach_step(const nsvcd__reacher *r, const double *q, double damping,
                              double *out, double *expected) {
  double step[NSVCD_MAX_JOINTS];
  int is_held[NSVCD_MAX_JOINTS];
  double left[NSVCD__MOST_ROWS], y[NSVCD__MOST_ROWS];
  const size_t rows = r->rows;
  size_t held = 0;
  for (size_t n = 0; n < r->count; n++) {
    is_held[n] = nsvcd__reach_holds(r, n);
    step[n] = 0;
  }
  for (size_t k = 0; k < rows; k++) left[k] = -r->miss.residuals[k];
  for (;;) {
    const size_t before = held;
    double m[NSVCD__MOST_ROWS][NSVCD__MOST_ROWS] = {{0}};
    double squares = 0;
    for (size_t n = 0; n < r->count; n++) {
      const double *column = r->jacobian[n];
      for (size_t i = 0; i < rows && !is_held[n]; i++) {
        for (size_t k = 0; k <= i; k++) m[i][k] += column[i] * column[k];
      }
    }
    for (size_t i = 0; i < rows; i++) squares += m[i][i];
    for (size_t i = 0; i < rows; i++)
      m[i][i] += damping + NSVCD__REACH_FLOOR * nsvcd__max(squares, 1e-30);
    nsvcd__solve_rows(m, left, rows, y);
    for (size_t n = 0; n < r->count; n++) {
      const double *column = r->jacobian[n];
      double sum = 0;
      if (is_held[n]) continue;
      for (size_t k = 0; k < rows; k++) sum += column[k] * y[k];
      step[n] = sum;
    }
    for (size_t n = 0; n < r->count; n++) {
      const size_t j = r->chain[n];
      const nsvcd_joint *joint = &r->scene->joints[j];
      const double up = (nsvcd__high_of(joint) - q[j]) / r->units[n];
      const double down = (nsvcd__low_of(joint) - q[j]) / r->units[n];
      if (is_held[n] || (step[n] <= up && step[n] >= down)) continue;
      step[n] = step[n] > up ? up : down;
      is_held[n] = 1;
      held++;
      for (size_t k = 0; k < rows; k++) left[k] -= r->jacobian[n][k] * step[n];
    }
    if (held == before) break;
  }
  memcpy(out, q, r->joints * sizeof *out);
  *expected = r->miss.cost;
  for (size_t k = 0; k < rows; k++) {
    double residual = r->miss.residuals[k];
    for (size_t n = 0; n < r->count; n++) residual += r->jacobian[n][k] * step[n];
    *expected -= 0.5 * residual * residual;
  }
  for (size_t n = 0; n < r->count; n++) out[r->chain[n]] += r->units[n] * step[n];
  nsvcd__follow(r->scene, 1, out);
}

// Goes from q to where the tool is at its target, or as near to that as it comes, until so many
// steps in a row win little. Returns 1 if it is there. r->miss: of that place.
static int nsvcd__descend(nsvcd__reacher *r, size_t most_stalls, double *q) {
  double damping = NSVCD__REACH_DAMPING;
  size_t stalls = 0;
  int is_reached = 0;
  nsvcd__reach_place(r, q);
  nsvcd__reach_differentiate(r);
  for (size_t n = 0; n < NSVCD__REACH_STEPS && stalls < most_stalls; n++) {
    double next[NSVCD_MAX_JOINTS];
    double expected;
    const nsvcd__miss was = r->miss;
    is_reached = nsvcd__is_reached(r);
    nsvcd__reach_step(r, q, damping * nsvcd__min(was.cost, 1), next, &expected);
    nsvcd__reach_place(r, next);
    const double gain = was.cost - r->miss.cost;
    if (gain > 0 && (!is_reached || nsvcd__is_reached(r))) {
      memcpy(q, next, r->joints * sizeof *q);
      nsvcd__reach_differentiate(r);
      if (gain > 0.5 * expected) damping *= NSVCD__REACH_EASIER;
    } else {
      r->miss = was;
      damping *= NSVCD__REACH_HARDER;
    }
    // one step more makes what is found from other starts the same
    if (is_reached) return 1;
    stalls = gain > NSVCD__REACH_GAIN * was.cost ? 0 : stalls + 1;
  }
  return nsvcd__is_reached(r);
}

// ---- starts and solutions

// Where a search begins that is not the start.
static void nsvcd__reach_draw(nsvcd__reacher *r, double *q) {
  memcpy(q, r->start, r->joints * sizeof *q);
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    const nsvcd_joint *joint = &r->scene->joints[j];
    if (nsvcd__reach_holds(r, n)) continue;
    const int is_bounded = joint->kind == NSVCD_JOINT_REVOLUTE;
    const double most = nsvcd__slides(r->checker, j) ? r->slide : 3.141592653589793;
    const double from = is_bounded ? joint->low : q[j] - most;
    const double to = is_bounded ? joint->high : q[j] + most;
    const double low = nsvcd__max(nsvcd__low_of(joint), from);
    const double high = nsvcd__min(nsvcd__high_of(joint), to);
    q[j] = low + (high - low) * nsvcd__random(&r->random);
  }
  nsvcd__follow(r->scene, 1, q);
}

// Takes joints that turn as near to the start as whole turns bring them within their limits. A step
// to a limit may be off it by a rounding.
static void nsvcd__reach_unwind(const nsvcd__reacher *r, double *q) {
  const double full_turn = 6.283185307179586;
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    const nsvcd_joint *joint = &r->scene->joints[j];
    double turns = floor((q[j] - r->start[j]) / full_turn + 0.5);
    if (nsvcd__slides(r->checker, j) || nsvcd__leads(r->scene, j)) continue;
    const double to = q[j] - full_turn * turns;
    // the next one is between the start and q
    if (to < nsvcd__low_of(joint) || to > nsvcd__high_of(joint)) turns -= turns > 0 ? 1 : -1;
    q[j] -= full_turn * turns;
  }
  nsvcd__clamp_to_limits(r->scene, q);
}

static void nsvcd__reach_note(const nsvcd__reacher *r, const double *q,
                              nsvcd_reach_answer *answer) {
  memcpy(answer->best, q, r->joints * sizeof *q);
  answer->position_error = r->miss.position;
  answer->angle_error = r->miss.angle;
}

// Is a configuration proven free, if it has to be? An error is in c->result.
static int nsvcd__reach_is_free(nsvcd__reacher *r, const double *q,
                                nsvcd_check_answer *found) {
  const nsvcd_joint_motion still = {0, 0, q, NULL};
  const nsvcd_check_options options = {r->options.clearance, 0, 0, r->problem.stop,
                                       r->problem.user,      0};
  if (r->options.may_touch) return 1;
  return !nsvcd_check(r->checker, &still, &options, found) && nsvcd__proves_free(found);
}

// Takes a configuration that has the tool at the target among the solutions, unless one beside it
// is as near to the start.
static void nsvcd__reach_take(nsvcd__reacher *r, const double *q, double *out,
                              nsvcd_reach_answer *answer) {
  const size_t joints = r->joints;
  const double apart2 = r->options.apart * r->options.apart;
  const double distance2 = nsvcd__distance2(q, r->start, joints);
  nsvcd_check_answer found;
  size_t kept = 0;
  memset(&found, 0, sizeof found);
  for (size_t n = 0; n < answer->solutions; n++) {
    const double *row = out + n * joints;
    const int is_beside = nsvcd__distance2(row, q, joints) < apart2;
    if (!is_beside || nsvcd__distance2(row, r->start, joints) > distance2) continue;
    r->repeats++;
    return;
  }
  if (!nsvcd__reach_is_free(r, q, &found)) {
    const double best2 = nsvcd__distance2(answer->best, r->start, joints);
    const int is_better = !answer->touching || distance2 < best2;
    answer->touching++;
    if (answer->solutions > 0 || !is_better) return;
    nsvcd__reach_note(r, q, answer);
    answer->check = found;
    return;
  }
  for (size_t n = 0; n < answer->solutions; n++) {
    const double *row = out + n * joints;
    if (nsvcd__distance2(row, q, joints) < apart2) continue;
    memmove(out + kept++ * joints, row, joints * sizeof *q);
  }
  size_t at = kept;
  while (at > 0 && nsvcd__distance2(out + (at - 1) * joints, r->start, joints) > distance2)
    at--;
  memmove(out + (at + 1) * joints, out + at * joints, (kept - at) * joints * sizeof *q);
  memcpy(out + at * joints, q, joints * sizeof *q);
  if (kept == answer->solutions) r->repeats = 0;
  answer->solutions = kept + 1;
  if (at == 0) nsvcd__reach_note(r, q, answer);
}

// Goes from q to the target. What that leads to is taken, or noted.
static void nsvcd__reach_from(nsvcd__reacher *r, size_t most_stalls, double *q, double *out,
                              nsvcd_reach_answer *answer) {
  int is_reached = nsvcd__descend(r, most_stalls, q);
  nsvcd__reach_unwind(r, q);
  nsvcd__reach_place(r, q);
  is_reached = is_reached && nsvcd__is_reached(r);
  answer->reached += (size_t)is_reached;
  if (is_reached) {
    nsvcd__reach_take(r, q, out, answer);
  } else if (!answer->reached && r->miss.cost < r->least) {
    r->least = r->miss.cost;
    nsvcd__reach_note(r, q, answer);
  }
}

// ---- the public function

static nsvcd_result nsvcd__reach_check(const nsvcd_checker *c, const nsvcd_reach_problem *p,
                                       const nsvcd_reach_options *o) {
  nsvcd_result result = nsvcd__check_joints(c, p->start);
  if (result) return result;
  if (p->link > c->scene->joint_count || p->target_link > c->scene->joint_count)
    return NSVCD_ERROR_LINK;
  result = nsvcd__poses_check(&p->tool, 1);
  if (!result) result = nsvcd__poses_check(&p->target, 1);
  if (result) return result;
  for (size_t k = 0; k < 3; k++)
    if (!nsvcd__is_length(p->half[k])) return NSVCD_ERROR_RADIUS;
  if (!nsvcd__in_range(p->free_axis, 3, 1e15f)) return NSVCD_ERROR_AXIS;
  const double tolerances[2] = {o->position_tolerance, o->angle_tolerance};
  if (!nsvcd__are_numbers(tolerances, 2) || tolerances[0] < 0 || tolerances[1] < 0)
    return NSVCD_ERROR_TOLERANCE;
  if (!nsvcd__are_numbers(&o->apart, 1) || o->apart < 0) return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__in_range(&o->clearance, 1, 0.5f * NSVCD_MAX_COORDINATE) || o->clearance < 0)
    return NSVCD_ERROR_CLEARANCE;
  return NSVCD_OK;
}

// Finds the joints between the tool and the target, and how long the chain is. Returns 0 if there
// are none.
static size_t nsvcd__reach_chain(nsvcd__reacher *r) {
  const nsvcd_joint *joints = r->scene->joints;
  const nsvcd_reach_problem *p = &r->problem;
  const nsvcd__dpose origin = {{0, 0, 0, 1}, {0, 0, 0}};
  double sides[NSVCD_MAX_JOINTS] = {0};
  int moves[NSVCD_MAX_JOINTS] = {0};
  uint32_t fork = p->link;
  for (uint32_t l = p->link; l; l = joints[l - 1].parent) sides[l - 1] += 1;
  for (uint32_t l = p->target_link; l; l = joints[l - 1].parent) sides[l - 1] -= 1;
  while (fork && sides[fork - 1] > 0) fork = joints[fork - 1].parent;
  r->at.frames[fork] = origin;
  if (p->link != fork) r->length += nsvcd__d3_norm(r->tool.position);
  if (p->target_link != fork) r->length += nsvcd__d3_norm(r->target.position);
  for (size_t j = 0; j < r->joints; j++)
    moves[nsvcd__driver(r->scene, j)] |= fabs(sides[j]) > 0;
  for (size_t j = 0; j < r->joints; j++) {
    const int is_between = fabs(sides[j]) > 0;
    if (!is_between && !moves[j]) continue;
    if (is_between && joints[j].parent != fork)
      r->length += nsvcd__d3_norm(r->checker->links[j].origin.position);
    r->sides[r->count] = sides[j];
    r->chain[r->count++] = j;
  }
  // of a chain without lengths, how far it has to go
  const double length = r->length;
  r->length = 1;
  nsvcd__reach_place(r, r->start);
  r->slide = length + r->miss.position;
  r->length = length > 0 ? length : r->slide > 0 ? r->slide : 1;
  for (size_t n = 0; n < r->count; n++)
    r->units[n] = nsvcd__slides(r->checker, r->chain[n]) ? r->length : 1;
  return r->count;
}

static void nsvcd__reach_begin(nsvcd__reacher *r, nsvcd_checker *c,
                               const nsvcd_reach_problem *problem,
                               const nsvcd_reach_options *options) {
  const nsvcd__d3 none = {0, 0, 0};
  nsvcd_reach_options *o = &r->options;
  memset(r, 0, sizeof *r);
  r->checker = c;
  r->scene = c->scene;
  r->joints = c->scene->joint_count;
  r->problem = *problem;
  *o = *options;
  if (!(o->position_tolerance > 0)) o->position_tolerance = NSVCD__REACH_TOLERANCE;
  if (!(o->angle_tolerance > 0)) o->angle_tolerance = NSVCD__REACH_TOLERANCE;
  if (!(o->apart > 0)) o->apart = NSVCD__REACH_APART;
  if (!o->starts) o->starts = NSVCD__REACH_STARTS;
  r->random = o->seed;
  r->rows = NSVCD__MOST_ROWS - (r->scene->cone_count == 0);
  r->tool = nsvcd__unit_dpose(&problem->tool);
  r->target = nsvcd__unit_dpose(&problem->target);
  r->free_axis = nsvcd__d3_unit(nsvcd__d3_load(problem->free_axis), none);
  r->has_free_axis = nsvcd__d3_norm(r->free_axis) > 0;
  memcpy(r->start, problem->start, r->joints * sizeof *r->start);
  nsvcd__clamp_to_limits(r->scene, r->start);
}

NSVCDDEF nsvcd_result nsvcd_reach(nsvcd_checker *checker, const nsvcd_reach_problem *problem,
                                  const nsvcd_reach_options *options, double *out,
                                  size_t capacity, nsvcd_reach_answer *answer) {
  nsvcd__reacher r;
  nsvcd_reach_options defaults;
  nsvcd_reach_answer found;
  if (!checker || !problem || !out || !answer) return NSVCD_ERROR_ARGUMENT;
  if (!capacity) return NSVCD_ERROR_COUNT;
  memset(&defaults, 0, sizeof defaults);
  memset(&found, 0, sizeof found);
  const nsvcd_result result =
      nsvcd__reach_check(checker, problem, options ? options : &defaults);
  if (result) return result;
  nsvcd__reach_begin(&r, checker, problem, options ? options : &defaults);
  if (!nsvcd__reach_chain(&r)) return NSVCD_ERROR_LINK;
  nsvcd__reach_place(&r, r.start);
  nsvcd__reach_note(&r, r.start, &found);
  r.least = r.miss.cost;
  checker->result = NSVCD_OK;
  double q[NSVCD_MAX_JOINTS];
  int is_stopped = 0;
  while (found.starts < r.options.starts && found.solutions < capacity &&
         r.repeats < NSVCD__REACH_REPEATS && !checker->result) {
    is_stopped = problem->stop && problem->stop(problem->user);
    if (is_stopped) break;
    memcpy(q, r.start, sizeof q);
    if (found.starts++ > 0) nsvcd__reach_draw(&r, q);
    nsvcd__reach_from(&r, NSVCD__REACH_STALLS, q, out, &found);
  }
  // by how much it is missed is to be told well
  memcpy(q, found.best, sizeof q);
  if (!found.reached && !is_stopped) nsvcd__reach_from(&r, NSVCD__REACH_STEPS, q, out, &found);
  if (!checker->result) *answer = found;
  return checker->result;
}

// ------------------------------------------------------------------------------------- robot/spans
// In: two parts of a scene. Out: the joints between them, how far these move a point of one part as
// the other sees it, and a checker of these two parts alone.
//
// THE BOUND. Let d(q) be the distance of two parts. If one joint turns by w, and the others stay,
// d changes by no more than w r: r is the farthest that a point of one part is from that joint's
// axis. That holds of either part, since turning one is turning the other back: so r is the lesser
// of both. Where a joint slides, r is 1. In a box of joint values, which reach h_k to either side
// of its centre, joints may change one after another. So from the centre d changes by no more than
//   sum over joints k of h_k r_k
// A joint that mimics another reaches its multiplier times as far.
// r_k: of all configurations of the box. It is that of the centre, where no point is farther than
// the part's sphere or the corners of its box, and what the joints between the
// part and k add: the chord 2 r sin(h / 2) of each, h up to pi, or h if it slides.
// Source: this library.

// metres, about: the extent of a probe
#define NSVCD__PROBE 1e-6
// of a clearance: how far a part may deviate at last
#define NSVCD__SPAN_FINEST 0.05

// A point that rides on one of the two parts: some body, shrunk, is put there as a third part.
typedef struct nsvcd__probe {
  // on which: 0 or 1
  int side;
  // in that part's link
  float position[3];
  // its depth in the other part, over how far it moves in a box
  double score;
} nsvcd__probe;

// Two parts, and the joints between them.
typedef struct nsvcd__span {
  nsvcd_scene scene;
  // the two, and the probe
  nsvcd_part parts[3];
  // the two; then the probe and one of them
  nsvcd_body_pair pairs[2];
  // of this scene
  nsvcd_checker *checker;
  // joints from the first part to the second, through the link that carries both; and which of
  // `path` drives each
  size_t way[NSVCD_MAX_JOINTS], drivers[NSVCD_MAX_JOINTS];
  size_t way_count;
  // those that drive them
  size_t path[NSVCD_MAX_JOINTS];
  size_t joints;
  // what joints off the path are at, and, of the path, the centre of a box
  double at[NSVCD_MAX_JOINTS];
  // of the path: the box, half its widths, and r of the banner
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  double half[NSVCD_MAX_JOINTS], arms[NSVCD_MAX_JOINTS];
  // of the way: half the widths, and the sines of half of these
  double reach[NSVCD_MAX_JOINTS], sines[NSVCD_MAX_JOINTS];
  // metres: what both parts go beyond their triangles, and these beyond those of their meshes
  double beyond;
  // metres: no point of a probe is farther from its position
  double probe_extent;
} nsvcd__span;

// The joints from link a to link b, in order. A link's parent has a lower number than the link.
static size_t nsvcd__path_between(const nsvcd_scene *scene, uint32_t a, uint32_t b,
                                  size_t *path) {
  size_t down[NSVCD_MAX_JOINTS];
  size_t count = 0;
  size_t down_count = 0;
  while (a != b) {
    uint32_t *outer = a > b ? &a : &b;
    *(outer == &a ? &path[count++] : &down[down_count++]) = *outer - 1;
    *outer = scene->joints[*outer - 1].parent;
  }
  while (down_count > 0) path[count++] = down[--down_count];
  return count;
}

// The least and the greatest value of a joint. A full turn is a little more than one.
static void nsvcd__values_of(const nsvcd_joint *joint, double *low, double *high) {
  const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
  *low = is_endless ? 0 : joint->low;
  *high = is_endless ? 6.28318530717960 : joint->high;
}

// A sphere about a part, or a probe, in the world; and a box about the part.
typedef struct nsvcd__rider {
  nsvcd__d3 centre;
  double radius;
  // the middle of the box, and from there to its sides; 0 of a probe
  nsvcd__d3 middle, sides[3];
} nsvcd__rider;

static nsvcd__rider nsvcd__rider_of(const nsvcd_checker *c, const nsvcd__links *at,
                                    size_t part) {
  const nsvcd__member *m = &c->members[part];
  const nsvcd__dpose *frame = &at->frames[c->scene->parts[part].link];
  const nsvcd__dpose at_part = nsvcd__dpose_mul(frame, &m->frame);
  nsvcd__rider out;
  out.centre = nsvcd__dpose_apply(frame, m->centre);
  out.radius = m->radius;
  out.middle = nsvcd__dpose_apply(&at_part, m->middle);
  for (size_t k = 0; k < 3; k++) {
    nsvcd__d3 side = {0, 0, 0};
    // distances are those of triangles
    nsvcd__d3_set_axis(&side, k, 1.000001 * (nsvcd__d3_axis(m->half, k) - m->round));
    out.sides[k] = nsvcd__dquat_rotate(at_part.rotation, side);
  }
  return out;
}

// The farthest that a point of a rider is from an axis through a point: no farther than a corner of
// its box, nor than its sphere reaches.
static double nsvcd__across(const nsvcd__rider *rider, nsvcd__d3 axis, nsvcd__d3 foot) {
  const nsvcd__d3 off = nsvcd__d3_cross(axis, nsvcd__d3_sub(rider->centre, foot));
  const nsvcd__d3 middle = nsvcd__d3_cross(axis, nsvcd__d3_sub(rider->middle, foot));
  double most = 0;
  for (size_t corner = 0; corner < 8; corner++) {
    nsvcd__d3 out = middle;
    for (size_t k = 0; k < 3; k++)
      out =
          nsvcd__d3_fma(corner >> k & 1 ? 1 : -1, nsvcd__d3_cross(axis, rider->sides[k]), out);
    most = nsvcd__max(most, nsvcd__d3_dot(out, out));
  }
  return nsvcd__min(nsvcd__d3_norm(off) + rider->radius, sqrt(most));
}

// r of the banner, of the joints of a way from one part to the other, which reach so far to either
// side. riders: each on the link of one part.
static void nsvcd__arms_along(const nsvcd_checker *c, const size_t *way, size_t count,
                              const double *reach, const nsvcd__links *at,
                              const nsvcd__rider *riders, double *arms) {
  for (size_t side = 0; side < 2; side++) {
    double moved = 0;
    for (size_t n = 0; n < count; n++) {
      const size_t k = side ? count - 1 - n : n;
      const size_t j = way[k];
      const double across =
          nsvcd__across(&riders[side], at->axes[j], at->frames[j + 1].position);
      const int slides = nsvcd__slides(c, j);
      const double arm = slides ? 1 : across + moved;
      const double half = nsvcd__min(reach[k], 3.141592653589793);
      moved += slides ? reach[k] : 2 * arm * sin(0.5 * half);
      arms[k] = side ? nsvcd__min(arms[k], arm) : arm;
    }
  }
}

// Those of the joints of a span's path, each with all that it drives.
static void nsvcd__arms_between(nsvcd__span *s, const nsvcd__links *at,
                                const nsvcd__rider *riders) {
  double rates[NSVCD_MAX_JOINTS], arms[NSVCD_MAX_JOINTS];
  for (size_t k = 0; k < s->way_count; k++) {
    rates[k] = fabs(nsvcd__rate(&s->scene, s->way[k]));
    s->reach[k] = rates[k] * s->half[s->drivers[k]];
    s->sines[k] = sin(0.5 * nsvcd__min(s->reach[k], 3.141592653589793));
  }
  nsvcd__arms_along(s->checker, s->way, s->way_count, s->reach, at, riders, arms);
  for (size_t k = 0; k < s->joints; k++) s->arms[k] = 0;
  for (size_t k = 0; k < s->way_count; k++) s->arms[s->drivers[k]] += rates[k] * arms[k];
}

// The bound of the banner, without one joint of the path, or NSVCD_NONE.
static double nsvcd__travel_but(const nsvcd__span *s, size_t without) {
  double sum = 0;
  for (size_t k = 0; k < s->joints; k++) sum += k == without ? 0 : s->half[k] * s->arms[k];
  return sum * (1 + 1e-9);
}

NSVCDDEF nsvcd_result nsvcd_pair_travel(const nsvcd_checker *c, nsvcd_body_pair pair,
                                        const double *low, const double *high, double *moved) {
  double middles[NSVCD_MAX_JOINTS] = {0};
  double half[NSVCD_MAX_JOINTS] = {0};
  double arms[NSVCD_MAX_JOINTS];
  size_t way[NSVCD_MAX_JOINTS];
  nsvcd__links at;
  if (!c || !low || !high || !moved) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = c->scene;
  if (pair.a >= scene->part_count || pair.b >= scene->part_count ||
      scene->parts[pair.a].link == scene->parts[pair.b].link)
    return NSVCD_ERROR_PAIR;
  const size_t count =
      nsvcd__path_between(scene, scene->parts[pair.a].link, scene->parts[pair.b].link, way);
  for (size_t k = 0; k < count; k++) {
    const size_t j = way[k];
    if (!nsvcd__are_numbers(&low[j], 1) || !nsvcd__are_numbers(&high[j], 1) ||
        low[j] > high[j])
      return NSVCD_ERROR_VALUE;
    const double middle = 0.5 * (low[j] + high[j]);
    middles[j] = middle;
    half[k] = nsvcd__max(high[j] - middle, middle - low[j]) * (1 + 1e-15);
  }
  nsvcd__place_links(c, middles, &at);
  const nsvcd__rider riders[2] = {nsvcd__rider_of(c, &at, pair.a),
                                  nsvcd__rider_of(c, &at, pair.b)};
  nsvcd__arms_along(c, way, count, half, &at, riders, arms);
  for (size_t j = 0; j < scene->joint_count; j++) moved[j] = 0;
  for (size_t k = 0; k < count; k++) moved[way[k]] = half[k] * arms[k] * (1 + 1e-9);
  return NSVCD_OK;
}

// The joint of the path that moves points farthest.
static size_t nsvcd__farthest_joint(const nsvcd__span *s) {
  size_t out = 0;
  for (size_t k = 1; k < s->joints; k++) {
    if (s->half[k] * s->arms[k] > s->half[out] * s->arms[out]) out = k;
  }
  return out;
}

// Asks about the two parts, or about the probe and the surface of the part that it does not ride
// on, in the configuration s->at, or along a joint of the path through all of the box.
static nsvcd_result nsvcd__ask_span(nsvcd__span *s, int is_probe, size_t along,
                                    double clearance, const nsvcd_range_options *o,
                                    nsvcd_check_answer *answer) {
  const size_t joints = s->scene.joint_count;
  double points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = {along != NSVCD_NONE, 1, points, NULL};
  nsvcd_check_options options = {0, 0, o->work, o->stop, o->user, 0};
  if (clearance > 0) options.clearance = nsvcd__above(clearance);
  options.finest = (float)nsvcd__max((double)NSVCD__FINEST, clearance * NSVCD__SPAN_FINEST);
  memcpy(points, s->at, joints * sizeof *points);
  memcpy(points + joints, s->at, joints * sizeof *points);
  if (along != NSVCD_NONE) {
    points[s->path[along]] = s->low[along];
    points[joints + s->path[along]] = s->high[along];
  }
  nsvcd__follow(&s->scene, 1 + (along != NSVCD_NONE), points);
  s->scene.pairs = s->checker->own.pairs = &s->pairs[is_probe];
  s->checker->surfaces = is_probe;
  return nsvcd_check(s->checker, &motion, &options, answer);
}

// Takes a box about whose centre s->at is then: (2, joints) of the path, low and high.
static void nsvcd__take_box(nsvcd__span *s, const double *box) {
  for (size_t k = 0; k < s->joints; k++) {
    s->low[k] = box[k];
    s->high[k] = box[s->joints + k];
    const double middle = 0.5 * (s->low[k] + s->high[k]);
    s->at[s->path[k]] = middle;
    s->half[k] = nsvcd__max(s->high[k] - middle, middle - s->low[k]) * (1 + 1e-15);
  }
  nsvcd__follow(&s->scene, 1, s->at);
}

// The parts and joints of a span, without its checker.
static void nsvcd__span_begin(const nsvcd_scene *scene, nsvcd_body_pair pair, nsvcd__span *s) {
  memset(s, 0, sizeof *s);
  s->scene = *scene;
  s->scene.parts = s->parts;
  s->scene.pairs = s->pairs;
  s->scene.part_count = 3;
  s->scene.pair_count = 1;
  s->scene.clearances = NULL;
  s->scene.allowances = NULL;
  s->scene.allowance_count = 0;
  s->scene.cone_count = 0;
  s->parts[0] = scene->parts[pair.a];
  s->parts[1] = scene->parts[pair.b];
  s->pairs[0].b = 1;
  s->way_count = nsvcd__path_between(scene, s->parts[0].link, s->parts[1].link, s->way);
  for (size_t n = 0; n < s->way_count; n++) {
    const size_t driver = nsvcd__driver(scene, s->way[n]);
    size_t k = 0;
    while (k < s->joints && s->path[k] != driver) k++;
    if (k == s->joints) s->path[s->joints++] = driver;
    s->drivers[n] = k;
  }
  for (size_t j = 0; j < scene->joint_count; j++) {
    double low, high;
    nsvcd__values_of(&scene->joints[j], &low, &high);
    s->at[j] = 0.5 * (low + high);
  }
  nsvcd__follow(scene, 1, s->at);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_body_facts facts = nsvcd_body_describe(s->parts[n].body);
    const double scale = s->parts[n].scale > 0 ? (double)s->parts[n].scale : 1;
    s->beyond += scale * ((double)facts.convex_radius + (double)facts.quantization_error);
  }
  // of all bodies the one with the fewest triangles
  nsvcd_part *probe = &s->parts[2];
  size_t fewest = SIZE_MAX;
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd_body_facts facts = nsvcd_body_describe(scene->parts[n].body);
    if (facts.triangles >= fewest) continue;
    fewest = facts.triangles;
    const float extent = facts.extent + facts.convex_radius;
    probe->body = scene->parts[n].body;
    probe->scale = (float)nsvcd__max(nsvcd__min(NSVCD__PROBE / (double)extent, 1),
                                     (double)NSVCD_MIN_SCALE);
    s->probe_extent = 1.00001 * (double)(extent * probe->scale);
  }
  probe->pose.rotation[3] = 1;
  // it has a row of samples if it is on a link that moves
  probe->link = s->parts[0].link ? s->parts[0].link : s->parts[1].link;
}

// Puts the probe at a point of the link of one of the parts.
static void nsvcd__put_probe(nsvcd__span *s, const nsvcd__probe *at) {
  nsvcd__member *m = &s->checker->members[2];
  const size_t row = m->row;
  s->parts[2].link = s->parts[at->side].link;
  memcpy(s->parts[2].pose.position, at->position, sizeof at->position);
  s->pairs[1].a = 2;
  s->pairs[1].b = at->side ? 0 : 1;
  *m = nsvcd__member_of(&s->parts[2]);
  m->row = row;
}

// ---------------------------------------------------------------------------------- robot/meetings
// In: two parts of a robot. Out: a configuration in which they meet, and one in which they do not.
//
// Configurations are drawn at random. From some of them the distance is followed down its slope
// until the parts meet, or up until they do not. A joint at its limit stays there while the slope
// leads beyond it.

// probes that are kept
#define NSVCD__KEPT_PROBES 4
// configurations that are drawn at first
#define NSVCD__RANGE_DRAWS 64
// slopes that are followed from configurations drawn at random, down, and up, which takes longer;
// steps of each; and the share of the first step below which one ends
#define NSVCD__SLOPES_DOWN 12
#define NSVCD__SLOPES_UP 2
#define NSVCD__SLOPE_STEPS 30
#define NSVCD__LEAST_STEP 0.01
// units for a question about the distance, of which a depth takes many
#define NSVCD__ROOM_WORK 2000
// units that a question takes beside its proof, about: placing parts, and asking
#define NSVCD__QUESTION_UNITS 40

typedef struct nsvcd__ranging {
  nsvcd__span span;
  nsvcd_range_options options;
  nsvcd_range_answer answer;
  // (capacity, 2 joints + 1): boxes that are left, and the fraction that each is of all values; a
  // ring
  double *boxes;
  size_t capacity, first, count;
  // that were given up: how many, and the fraction
  size_t dropped_count;
  double dropped;
  // best first
  nsvcd__probe probes[NSVCD__KEPT_PROBES];
  size_t probe_count;
  // boxes that failed
  size_t failed;
  // units beside those that proofs took
  uint64_t units;
  uint64_t random;
  nsvcd_result result;
} nsvcd__ranging;

// ---- asking

// Is it known, is there an error, or no work left?
static int nsvcd__range_is_over(nsvcd__ranging *r) {
  const nsvcd_range_options *o = &r->options;
  if (r->result || (r->answer.has_free && r->answer.has_hit)) return 1;
  if (r->units + r->span.checker->units < o->units && (!o->stop || !o->stop(o->user)))
    return 0;
  r->answer.why = NSVCD_WHY_WORK;
  return 1;
}

// Asks as nsvcd__ask_span does. UNDECIDED if there is an error, which is in r->result.
static nsvcd_verdict nsvcd__ask_range(nsvcd__ranging *r, int is_probe, size_t along,
                                      double clearance, nsvcd_check_answer *found) {
  memset(found, 0, sizeof *found);
  r->units += NSVCD__QUESTION_UNITS;
  if (!r->result)
    r->result = nsvcd__ask_span(&r->span, is_probe, along, clearance, &r->options, found);
  return found->verdict;
}

// Asks about the two parts in the configuration span.at, and notes what is known there.
static nsvcd_verdict nsvcd__note_here(nsvcd__ranging *r) {
  nsvcd_check_answer found;
  nsvcd__span *s = &r->span;
  const size_t bytes = s->scene.joint_count * sizeof *s->at;
  nsvcd__follow(&s->scene, 1, s->at);
  (void)nsvcd__ask_range(r, 0, NSVCD_NONE, (double)r->options.clearance, &found);
  if (r->result) return NSVCD_UNDECIDED;
  if (found.verdict == NSVCD_FREE && !r->answer.has_free) {
    memcpy(r->answer.free, s->at, bytes);
    r->answer.has_free = 1;
  }
  if (found.verdict == NSVCD_HIT && !r->answer.has_hit) {
    memcpy(r->answer.hit, s->at, bytes);
    r->answer.has_hit = 1;
  }
  if (found.verdict == NSVCD_UNDECIDED) r->answer.why = found.why;
  return found.verdict;
}

// ---- slopes

// Metres: how far the parts are from coming as near as the clearance, in the configuration span.at;
// less than 0 if they do. No more than a tenth of `about` too much. Returns 0 if nothing is known.
static int nsvcd__room_here(nsvcd__ranging *r, double about, nsvcd_proximity *nearest,
                            double *room) {
  nsvcd__span *s = &r->span;
  nsvcd_checker *c = s->checker;
  const float to = (float)nsvcd__max(1e-5, nsvcd__min(1e-3, 0.1 * fabs(about)));
  const nsvcd_proximity_options o = {NSVCD_MAX_COORDINATE / 4, to, 0.1f, NSVCD__ROOM_WORK};
  r->units += NSVCD__QUESTION_UNITS;
  s->scene.pairs = c->own.pairs = s->pairs;
  nsvcd__follow(&s->scene, 1, s->at);
  c->surfaces = 0;
  c->result = NSVCD_OK;
  nsvcd__place_links(c, s->at, c->at);
  nsvcd__place_sample(c, c->at, 0);
  if (!nsvcd__proximity_of(c, 0, &o, nearest) || c->result) return 0;
  const int is_hit = nearest->verdict == NSVCD_HIT;
  *room = is_hit ? -(double)nearest->depth : (double)nearest->distance.high;
  *room -= (double)r->options.clearance;
  return 1;
}

// Moves span.at along the slope, so far that the room would change by `change`.
static int nsvcd__move_along(nsvcd__span *s, const double *slope, double change) {
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  double square = 0;
  for (size_t k = 0; k < s->joints; k++) {
    const size_t j = s->path[k];
    nsvcd__values_of(&s->scene.joints[j], &low[k], &high[k]);
    const int rises = slope[j] * change > 0;
    const int is_stuck = rises ? !(s->at[j] < high[k]) : !(s->at[j] > low[k]);
    if (is_stuck) low[k] = high[k] = s->at[j];
    square += is_stuck ? 0 : slope[j] * slope[j];
  }
  if (!(square > 0)) return 0;
  for (size_t k = 0; k < s->joints; k++) {
    const size_t j = s->path[k];
    const double to = s->at[j] + change / square * slope[j];
    s->at[j] = nsvcd__max(low[k], nsvcd__min(high[k], to));
  }
  return 1;
}

// From the configuration span.at on, down the slope of the distance until the parts meet (sign -1),
// or up until they do not (1).
static void nsvcd__follow_slope(nsvcd__ranging *r, double sign) {
  nsvcd__span *s = &r->span;
  double last[NSVCD_MAX_JOINTS];
  double room, next_room;
  double step = 1;
  nsvcd_proximity nearest, next;
  if (!nsvcd__room_here(r, 1, &nearest, &room)) return;
  for (size_t n = 0; n < NSVCD__SLOPE_STEPS && step > NSVCD__LEAST_STEP; n++) {
    memcpy(last, s->at, sizeof last);
    if (nsvcd__range_is_over(r) ||
        !nsvcd__move_along(s, nearest.slope, sign * step * (fabs(room) + 1e-3)) ||
        !nsvcd__room_here(r, room, &next, &next_room))
      return;
    if (sign * next_room > sign * room) {
      nearest = next;
      room = next_room;
      step = nsvcd__min(1, 2 * step);
      if (!(sign * room < 0)) (void)nsvcd__note_here(r);
    } else {
      memcpy(s->at, last, sizeof last);
      step *= 0.25;
    }
  }
}

// ---- draws

// Puts span.at at random values; or those that are bits of `corner` at their least or greatest.
static void nsvcd__draw_values(nsvcd__ranging *r, size_t corner) {
  nsvcd__span *s = &r->span;
  for (size_t k = 0; k < s->joints; k++) {
    double low, high;
    nsvcd__values_of(&s->scene.joints[s->path[k]], &low, &high);
    const double random = nsvcd__random(&r->random);
    const double end = s->joints < 5 ? (double)(corner >> k & 1) : random < 0.5;
    s->at[s->path[k]] = low + (corner == NSVCD_NONE ? random : end) * (high - low);
  }
}

// Tries corners of the ranges, and then configurations drawn at random.
static void nsvcd__try_draws(nsvcd__ranging *r) {
  const size_t joints = r->span.joints;
  const size_t corners = joints < 5 ? (size_t)1 << joints : 32;
  for (size_t n = 0; n < NSVCD__RANGE_DRAWS && !nsvcd__range_is_over(r); n++) {
    nsvcd__draw_values(r, n < corners ? n : NSVCD_NONE);
    (void)nsvcd__note_here(r);
  }
}

// Follows slopes from configurations drawn at random.
static void nsvcd__try_slopes(nsvcd__ranging *r, size_t count, double sign) {
  for (size_t n = 0; n < count && !nsvcd__range_is_over(r); n++) {
    nsvcd__draw_values(r, NSVCD_NONE);
    nsvcd__follow_slope(r, sign);
  }
}

// ---------------------------------------------------------------------------------- robot/partings
// In: two parts, and a box of values of the joints between them. Out: does a plane part them in all
// of it?
//
// THE BOUND. The plane is fixed in some link between the two: joints up to there move the one part,
// those beyond it the other. From the centre of the box joints may change one after another, the
// outer ones first, so that each still has the axis that it has at the centre. A point p that outer
// joints have displaced by m or less is then turned by w about an axis through f, of direction x.
// Its way is across x. So along the plane's normal n, of which c is across x, it is no more than
//   sin |w| |n . (x, p' - f)| + (1 - cos w) c r  <=  h (|n . (x, p - f)| + c m) + h^2 c r / 2
// where (,) is the vector product, p' the displaced point, r its distance from the axis, and h the
// most that |w| is; nor is it more than c times the chord 2 r sin(h / 2), h up to pi. The chord is
// added to m for joints further in. One that slides moves the point by h |n . x|. For a given
// configuration n . p is linear in p, so that of all points of a box about a part a corner comes
// farthest.
// Source: this library.

// of all lengths: errors of frames in double
#define NSVCD__PARTING_ROUNDING 1e-9

// A plane, fixed behind so many joints, counted from the first part.
typedef struct nsvcd__parting {
  nsvcd__d3 normal;
  size_t fixed;
  // metres, at least: how far apart the two are along it in all of the box, and at its centre
  double apart, centre;
} nsvcd__parting;

// By how much one joint of the way can bring a point nearer along a direction, at most. moved: by
// how much joints further out can displace it, to which this one is added.
static double nsvcd__loss_along(const nsvcd__span *s, const nsvcd__links *at, size_t k,
                                nsvcd__d3 p, nsvcd__d3 along, double *moved) {
  const size_t j = s->way[k];
  const nsvcd__d3 axis = at->axes[j];
  const double h = s->reach[k];
  const double before = *moved;
  if (nsvcd__slides(s->checker, j)) {
    *moved += h;
    return h * fabs(nsvcd__d3_dot(along, axis));
  }
  const nsvcd__d3 off = nsvcd__d3_cross(axis, nsvcd__d3_sub(p, at->frames[j + 1].position));
  const double r = nsvcd__d3_norm(off) + before;
  const double chord = 2 * r * s->sines[k];
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(along, axis));
  const double way = h * (fabs(nsvcd__d3_dot(along, off)) + across * (before + 0.5 * h * r));
  *moved += chord;
  return nsvcd__min(way, across * chord);
}

static nsvcd__d3 nsvcd__corner_of(const nsvcd__rider *rider, size_t corner) {
  nsvcd__d3 p = rider->middle;
  for (size_t k = 0; k < 3; k++)
    p = nsvcd__d3_fma(corner >> k & 1 ? 1 : -1, rider->sides[k], p);
  return p;
}

// The least that points of a part are along a direction, in all of the box: least[n] if the plane
// is fixed behind n joints, counted from the part.
static void nsvcd__least_along(const nsvcd__span *s, const nsvcd__links *at,
                               const nsvcd__rider *rider, size_t side, nsvcd__d3 along,
                               double *least) {
  for (size_t corner = 0; corner < 8; corner++) {
    const nsvcd__d3 p = nsvcd__corner_of(rider, corner);
    double moved = 0;
    double value = nsvcd__d3_dot(along, p);
    for (size_t n = 0; n <= s->way_count; n++) {
      least[n] = corner ? nsvcd__min(least[n], value) : value;
      if (n == s->way_count) break;
      const size_t k = side ? s->way_count - 1 - n : n;
      value -= nsvcd__loss_along(s, at, k, p, along, &moved);
    }
  }
}

// Of all planes with this normal, of length 1 or less, the one that parts the two by most.
static nsvcd__parting nsvcd__parting_along(const nsvcd__span *s, const nsvcd__links *at,
                                           const nsvcd__rider *riders, nsvcd__d3 normal) {
  double least[2][NSVCD_MAX_JOINTS + 1];
  nsvcd__parting out = {normal, 0, -HUGE_VAL, 0};
  for (size_t side = 0; side < 2; side++)
    nsvcd__least_along(s, at, &riders[side], side, nsvcd__d3_scale(normal, side ? -1 : 1),
                       least[side]);
  for (size_t n = 0; n <= s->way_count; n++) {
    const double apart = least[0][n] + least[1][s->way_count - n];
    if (!(apart > out.apart)) continue;
    out.apart = apart;
    out.fixed = n;
  }
  const double sizes = 1 + fabs(least[0][0]) + fabs(least[1][0]);
  out.apart -= NSVCD__PARTING_ROUNDING * sizes;
  out.centre = least[0][0] + least[1][0];
  return out;
}

// A plane that parts the two by more than the clearance in all of the box; or the best of those
// that are tried. Their normals are the direction from middle to middle, those of the sides of both
// boxes, and those of the joints' axes, along which these move nothing.
static nsvcd__parting nsvcd__best_parting(const nsvcd__span *s, const nsvcd__links *at,
                                          const nsvcd__rider *riders, double clearance) {
  const nsvcd__d3 between = nsvcd__d3_sub(riders[0].middle, riders[1].middle);
  nsvcd__parting best = {between, 0, -HUGE_VAL, -HUGE_VAL};
  for (size_t n = 0; n < 7 + s->way_count && !(best.apart > clearance); n++) {
    nsvcd__d3 normal = between;
    if (n > 0 && n < 7) normal = riders[(n - 1) / 3].sides[(n - 1) % 3];
    if (n >= 7) normal = at->axes[s->way[n - 7]];
    const double length = nsvcd__d3_norm(normal) * (1 + 1e-12);
    if (!(length > 0)) continue;
    const double sign = nsvcd__d3_dot(normal, between) < 0 ? -1 : 1;
    const nsvcd__parting found =
        nsvcd__parting_along(s, at, riders, nsvcd__d3_scale(normal, sign / length));
    if (found.apart > best.apart) best = found;
  }
  return best;
}

// Metres, of each joint of the path: by how much it can bring the two nearer along a parting.
static void nsvcd__losses_of(const nsvcd__span *s, const nsvcd__links *at,
                             const nsvcd__rider *riders, const nsvcd__parting *parting,
                             double *losses) {
  for (size_t k = 0; k < s->joints; k++) losses[k] = 0;
  for (size_t side = 0; side < 2; side++) {
    const size_t count = side ? s->way_count - parting->fixed : parting->fixed;
    for (size_t corner = 0; corner < 8; corner++) {
      const nsvcd__d3 p = nsvcd__corner_of(&riders[side], corner);
      double moved = 0;
      for (size_t n = 0; n < count; n++) {
        const size_t k = side ? s->way_count - 1 - n : n;
        double *loss = &losses[s->drivers[k]];
        *loss = nsvcd__max(*loss, nsvcd__loss_along(s, at, k, p, parting->normal, &moved));
      }
    }
  }
}

// ------------------------------------------------------------------------------------ robot/ranges
// In: two parts of a robot. Out: do they meet never, always or sometimes, over all values of the
// joints between them?
//
// Some configurations are tried first (robot/meetings.h). If the parts meet in some and not in
// others, that is the answer. If they meet in none, boxes of values are proven to be free; if in
// all, to be such that a point of one part stays inside of the other:
//
//   free   a plane that parts the two (robot/partings.h); or a sweep along one joint of the box,
//          with all that the other joints can move a point as a clearance (robot/spans.h)
//   hit    a point inside of both parts rides on one of them. Along the same sweep, with the same
//          clearance, it does not meet the surface of the other part: so it stays inside of it. Two
//          solids that have a point in common meet: either their surfaces do, or a component of one
//          is inside of the other
//
// A box that is neither is cut in two, along the joint that moves points farthest; or, where the
// best plane is nearer to being enough than the sweep, that brings them nearest along its normal.

// the default; and of a box, beside its questions
#define NSVCD__RANGE_UNITS 4000000
#define NSVCD__BOX_UNITS 10
// boxes that are kept. While more than half of these are left, the newest is taken first, so that
// they are not too many
#define NSVCD__KEPT_BOXES 4096
// boxes that are given up before the search is
#define NSVCD__MOST_DROPPED 64
// the first boxes that fail, and every so many later, have the slope followed
#define NSVCD__FIRST_SLOPES 24
#define NSVCD__NEXT_SLOPES 64
// metres: a box in which points move by less is not cut
#define NSVCD__LEAST_TRAVEL 2e-5
// the share of the joint that is swept along, when a box is cut
#define NSVCD__SWEPT_SHARE 0.25
// points on each axis, and others, that are tried for a probe
#define NSVCD__AXIS_POINTS 8
#define NSVCD__OTHER_POINTS 32
// units for a question about a probe in one configuration
#define NSVCD__PROBE_WORK 20000

// ---- boxes

static double *nsvcd__box_at(nsvcd__ranging *r, size_t n) {
  return r->boxes + (r->first + n) % r->capacity * (2 * r->span.joints + 1);
}

// Gives the box that was taken up.
static void nsvcd__drop_box(nsvcd__ranging *r, const double *box) {
  r->dropped += box[2 * r->span.joints];
  r->dropped_count++;
}

// Cuts the box that was taken, along the joint of its path that moves most.
static void nsvcd__cut_box(nsvcd__ranging *r, const double *box, const double *moved) {
  const nsvcd__span *s = &r->span;
  const size_t size = 2 * s->joints + 1;
  const double share = box[size - 1];
  size_t joint = 0;
  for (size_t k = 1; k < s->joints; k++)
    if (moved[k] > moved[joint]) joint = k;
  if (!(nsvcd__travel_but(s, NSVCD_NONE) > NSVCD__LEAST_TRAVEL)) {
    if (!r->answer.why) r->answer.why = NSVCD_WHY_TOO_NEAR;
    nsvcd__drop_box(r, box);
    return;
  }
  if (r->count + 2 > r->capacity) {
    r->answer.why = NSVCD_WHY_WORK;
    nsvcd__drop_box(r, box);
    return;
  }
  for (size_t n = 0; n < 2; n++) {
    double *half = nsvcd__box_at(r, r->count++);
    memcpy(half, box, size * sizeof *half);
    half[n ? joint : s->joints + joint] = s->at[s->path[joint]];
    half[size - 1] = 0.5 * share;
  }
}

// Asks about the configuration that a check names, where the parts are near each other or not; from
// there the slope is followed, if enough boxes failed.
static void nsvcd__try_near(nsvcd__ranging *r, size_t along, const nsvcd_check_answer *found,
                            double sign) {
  nsvcd__span *s = &r->span;
  double centre[NSVCD_MAX_JOINTS];
  const size_t failed = r->failed++;
  const int is_followed = failed < NSVCD__FIRST_SLOPES || failed % NSVCD__NEXT_SLOPES == 0;
  const int is_near = !(found->contact.gap > r->options.clearance);
  if (!is_followed && sign < 0 && !is_near) return;
  memcpy(centre, s->at, sizeof centre);
  if (along != NSVCD_NONE)
    s->at[s->path[along]] = s->low[along] + found->fraction * (s->high[along] - s->low[along]);
  (void)nsvcd__note_here(r);
  if (is_followed && !nsvcd__range_is_over(r)) nsvcd__follow_slope(r, sign);
  memcpy(s->at, centre, sizeof centre);
}

// Is the box free, all of it? If not, it is cut. Where its centre is too near, no sweep through it
// is free.
static void nsvcd__prove_free(nsvcd__ranging *r, const double *box) {
  nsvcd__span *s = &r->span;
  nsvcd_check_answer found;
  nsvcd__links at;
  double moved[NSVCD_MAX_JOINTS];
  nsvcd__place_links(s->checker, s->at, &at);
  const nsvcd__rider riders[2] = {nsvcd__rider_of(s->checker, &at, 0),
                                  nsvcd__rider_of(s->checker, &at, 1)};
  nsvcd__arms_between(s, &at, riders);
  r->units += NSVCD__BOX_UNITS;
  const double kept = (double)r->options.clearance + s->beyond;
  const nsvcd__parting parting = nsvcd__best_parting(s, &at, riders, kept);
  if (parting.apart > kept) return;
  const size_t along = nsvcd__farthest_joint(s);
  const double travel = nsvcd__travel_but(s, along);
  const double clearance = (double)r->options.clearance + travel;
  size_t asked = NSVCD_NONE;
  if (nsvcd__ask_range(r, 0, asked, clearance, &found) == NSVCD_FREE) {
    asked = along;
    if (nsvcd__ask_range(r, 0, asked, clearance, &found) == NSVCD_FREE) return;
  }
  if (r->result) return;
  if (found.verdict == NSVCD_HIT) nsvcd__try_near(r, asked, &found, -1);
  if (travel > 0) {
    for (size_t k = 0; k < s->joints; k++) moved[k] = s->half[k] * s->arms[k];
    moved[along] *= NSVCD__SWEPT_SHARE;
    // by how much of the room that there is for it either bound is too much
    const double room =
        nsvcd__max((double)found.contact.gap - (double)r->options.clearance, 0);
    if ((parting.centre - parting.apart) * room < travel * (parting.centre - kept))
      nsvcd__losses_of(s, &at, riders, &parting, moved);
    nsvcd__cut_box(r, box, moved);
    return;
  }
  // no more can be told of it
  r->answer.why = found.why ? found.why : NSVCD_WHY_TOO_NEAR;
  nsvcd__drop_box(r, box);
}

// ---- probes

// Is a probe inside a part, for certain, and farther from its surface than `room`?
static int nsvcd__is_enclosed_by(nsvcd__span *s, nsvcd_question q, double room) {
  nsvcd_checker *c = s->checker;
  nsvcd_answer found;
  q.surfaces = 0;
  if (nsvcd__ask_sweep(c, &q, &found) != NSVCD_HIT || !found.inside) return 0;
  q.surfaces = 1;
  q.clearance = nsvcd__above(room);
  return nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE;
}

// Is the probe inside the part that it rides on? Both are in that part's link, in poses that are
// not rounded.
static int nsvcd__is_own_point(nsvcd__span *s, const nsvcd__probe *probe) {
  const nsvcd_part *parts[2] = {&s->parts[2], &s->parts[probe->side]};
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  for (size_t n = 0; n < 2; n++) {
    nsvcd_mover *mover = n ? &q.b : &q.a;
    mover->body = parts[n]->body;
    mover->scale = parts[n]->scale;
    mover->poses = &parts[n]->pose;
    mover->count = 1;
  }
  q.method = NSVCD_METHOD_PROOF;
  q.work = NSVCD__PROBE_WORK;
  return nsvcd__is_enclosed_by(s, q, 2 * s->probe_extent);
}

// Is the probe inside the other part, in a configuration? *room: metres, at least as far is the
// surface to be, so that what is said of the rounded poses holds of the exact ones.
static int nsvcd__is_common_point(nsvcd__span *s, const nsvcd__links *at, double *room) {
  nsvcd_checker *c = s->checker;
  *c->at = *at;
  const nsvcd__local local = nsvcd__localize_at(c, &s->pairs[1]);
  const nsvcd_question q = nsvcd__question_of(c, &s->pairs[1], 1, NSVCD__PROBE_WORK);
  *room = 2 * (s->probe_extent + local.rounding);
  return nsvcd__is_enclosed_by(s, q, *room);
}

// The span's arms for a probe, which has been put in its place.
static void nsvcd__arms_of_probe(nsvcd__span *s, const nsvcd__links *at, size_t side) {
  nsvcd__rider riders[2];
  riders[side] = nsvcd__rider_of(s->checker, at, 2);
  const double radius = 2 * s->probe_extent;
  riders[side].radius = radius;
  riders[side].middle = riders[side].centre;
  for (size_t k = 0; k < 3; k++) {
    riders[side].sides[k] = nsvcd__d3_of(0, 0, 0);
    nsvcd__d3_set_axis(&riders[side].sides[k], k, radius);
  }
  riders[!side] = nsvcd__rider_of(s->checker, at, !side);
  nsvcd__arms_between(s, at, riders);
}

// Keeps a probe at a point of the world, if it is in both parts and among the best.
static void nsvcd__try_probe(nsvcd__ranging *r, const nsvcd__links *at, size_t side,
                             nsvcd__d3 point) {
  nsvcd__span *s = &r->span;
  nsvcd__probe probe;
  nsvcd_answer found;
  double room;
  const nsvcd__dpose *link = &at->frames[s->parts[side].link];
  const nsvcd__d3 off = nsvcd__d3_sub(point, link->position);
  const nsvcd__d3 in = nsvcd__dquat_rotate(nsvcd__dquat_inverse(link->rotation), off);
  probe.side = (int)side;
  nsvcd__f3_store(nsvcd__f3_round(in), probe.position);
  nsvcd__put_probe(s, &probe);
  s->checker->result = NSVCD_OK;
  if (!nsvcd__is_own_point(s, &probe) || !nsvcd__is_common_point(s, at, &room)) return;
  nsvcd_question q = nsvcd__question_of(s->checker, &s->pairs[1], 1, NSVCD__PROBE_WORK);
  q.surfaces = 1;
  q.ask = NSVCD_ASK_DISTANCE;
  (void)nsvcd__ask_sweep(s->checker, &q, &found);
  nsvcd__arms_of_probe(s, at, side);
  probe.score = (double)found.distance.low / (nsvcd__travel_but(s, NSVCD_NONE) + 1e-6);
  if (r->probe_count == NSVCD__KEPT_PROBES &&
      !(probe.score > r->probes[NSVCD__KEPT_PROBES - 1].score))
    return;
  size_t n = r->probe_count < NSVCD__KEPT_PROBES ? r->probe_count++ : NSVCD__KEPT_PROBES - 1;
  for (; n > 0 && r->probes[n - 1].score < probe.score; n--) r->probes[n] = r->probes[n - 1];
  r->probes[n] = probe;
}

// Seeks probes in the configuration span.at: on the axes of joints, about which they hardly move,
// and wherever both parts may be.
static void nsvcd__seek_probes(nsvcd__ranging *r, const nsvcd__links *at) {
  nsvcd__span *s = &r->span;
  const nsvcd__rider a = nsvcd__rider_of(s->checker, at, 0);
  const nsvcd__rider b = nsvcd__rider_of(s->checker, at, 1);
  const nsvcd__rider *small = a.radius < b.radius ? &a : &b;
  const size_t on_axes = NSVCD__AXIS_POINTS * s->way_count;
  nsvcd__bounds bounds[2];
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__dpose frame = nsvcd__frame_of_part(s->checker, at, n);
    bounds[n] = nsvcd__bounds_of(&s->checker->members[n], &frame);
  }
  const nsvcd__d3 low = nsvcd__d3_max(bounds[0].low, bounds[1].low);
  const nsvcd__d3 high = nsvcd__d3_min(bounds[0].high, bounds[1].high);
  r->probe_count = 0;
  for (size_t n = 0; n < on_axes + NSVCD__OTHER_POINTS && !nsvcd__range_is_over(r); n++) {
    nsvcd__d3 point = low;
    for (size_t k = 0; k < 3; k++) {
      const double to = nsvcd__d3_axis(high, k);
      const double from = nsvcd__d3_axis(low, k);
      nsvcd__d3_set_axis(&point, k, from + nsvcd__random(&r->random) * (to - from));
    }
    if (n < on_axes) {
      const size_t j = s->way[n / NSVCD__AXIS_POINTS];
      const nsvcd__d3 foot = at->frames[j + 1].position;
      const double along = nsvcd__d3_dot(nsvcd__d3_sub(small->centre, foot), at->axes[j]);
      const double shift = (2 * nsvcd__random(&r->random) - 1) * small->radius;
      point = nsvcd__d3_fma(along + shift, at->axes[j], foot);
    }
    for (size_t side = 0; side < 2; side++) nsvcd__try_probe(r, at, side, point);
  }
}

// Does a probe stay inside of the other part in all of the box? If not, it is asked whether the
// parts meet where the probe leaves it.
static int nsvcd__stays_inside(nsvcd__ranging *r, const nsvcd__links *at,
                               const nsvcd__probe *probe) {
  nsvcd__span *s = &r->span;
  nsvcd_check_answer found;
  double room;
  nsvcd__put_probe(s, probe);
  s->checker->result = NSVCD_OK;
  if (!nsvcd__is_common_point(s, at, &room)) return 0;
  nsvcd__arms_of_probe(s, at, (size_t)probe->side);
  const size_t along = nsvcd__farthest_joint(s);
  const double travel = nsvcd__travel_but(s, along);
  if (nsvcd__ask_range(r, 1, along, travel + room, &found) == NSVCD_FREE) return 1;
  if (r->result) return 0;
  if (found.verdict == NSVCD_HIT && !nsvcd__range_is_over(r))
    nsvcd__try_near(r, along, &found, 1);
  return 0;
}

// Do the parts meet everywhere in the box? If that is not known, it is cut.
static void nsvcd__prove_hit(nsvcd__ranging *r, const double *box) {
  nsvcd__span *s = &r->span;
  double moved[NSVCD_MAX_JOINTS];
  nsvcd__links at;
  nsvcd__place_links(s->checker, s->at, &at);
  if (nsvcd__note_here(r) == NSVCD_FREE || r->result) return;
  for (size_t attempt = 0; attempt < 2; attempt++) {
    if (attempt) nsvcd__seek_probes(r, &at);
    for (size_t n = 0; n < r->probe_count; n++) {
      if (nsvcd__stays_inside(r, &at, &r->probes[n]) || nsvcd__range_is_over(r)) return;
    }
  }
  const nsvcd__rider riders[2] = {nsvcd__rider_of(s->checker, &at, 0),
                                  nsvcd__rider_of(s->checker, &at, 1)};
  if (!r->probe_count) nsvcd__arms_between(s, &at, riders);
  for (size_t k = 0; k < s->joints; k++) moved[k] = s->half[k] * s->arms[k];
  nsvcd__cut_box(r, box, moved);
}

// ---- the search

// Looks into boxes until all are decided; is_free: proves them to be free, else to be hit. Returns
// 1 if all of them are.
static int nsvcd__search_boxes(nsvcd__ranging *r, int is_free) {
  nsvcd__span *s = &r->span;
  const size_t size = 2 * s->joints + 1;
  double box[2 * NSVCD_MAX_JOINTS + 1];
  for (size_t k = 0; k < s->joints; k++)
    nsvcd__values_of(&s->scene.joints[s->path[k]], &r->boxes[k], &r->boxes[s->joints + k]);
  r->boxes[size - 1] = 1;
  r->first = 0;
  r->count = 1;
  r->dropped = 0;
  r->dropped_count = 0;
  r->failed = 0;
  r->answer.open = 1;
  r->answer.why = NSVCD_WHY_NOTHING;
  while (r->count > 0 && r->dropped_count < NSVCD__MOST_DROPPED && !nsvcd__range_is_over(r)) {
    if (r->answer.boxes == r->options.boxes) {
      r->answer.why = NSVCD_WHY_WORK;
      break;
    }
    const int is_oldest = r->count <= r->capacity / 2;
    memcpy(box, nsvcd__box_at(r, is_oldest ? 0 : r->count - 1), size * sizeof *box);
    r->first = (r->first + (size_t)is_oldest) % r->capacity;
    r->count--;
    r->answer.boxes++;
    nsvcd__take_box(s, box);
    (is_free ? nsvcd__prove_free : nsvcd__prove_hit)(r, box);
    // it may have been found that this search is in vain
    if (is_free ? r->answer.has_hit : r->answer.has_free) return 0;
  }
  r->answer.open = r->dropped;
  for (size_t n = 0; n < r->count; n++) r->answer.open += nsvcd__box_at(r, n)[size - 1];
  return !r->result && r->count == 0 && !(r->dropped > 0);
}

// Can anything be proven to be inside of a part?
static int nsvcd__may_enclose(const nsvcd_part *part) {
  const nsvcd_body_facts facts = nsvcd_body_describe(part->body);
  return !facts.open && facts.open_components < facts.components;
}

// The parts meet in all configurations that were tried: do they in all?
static void nsvcd__find_always(nsvcd__ranging *r) {
  nsvcd_range_answer *a = &r->answer;
  const nsvcd_part *parts = r->span.parts;
  if (nsvcd__may_enclose(&parts[0]) && nsvcd__may_enclose(&parts[1])) {
    if (nsvcd__search_boxes(r, 0)) a->meeting = NSVCD_MEETS_ALWAYS;
    return;
  }
  nsvcd__try_slopes(r, NSVCD__SLOPES_UP, 1);
  a->open = 1;
  if (!a->why) a->why = NSVCD_WHY_OPEN;
}

static void nsvcd__find_range(nsvcd__ranging *r) {
  nsvcd_range_answer *a = &r->answer;
  nsvcd__try_draws(r);
  // with few joints boxes are quicker
  if (!a->has_hit && r->span.joints > 2) nsvcd__try_slopes(r, NSVCD__SLOPES_DOWN, -1);
  if (!a->has_hit && nsvcd__search_boxes(r, 1)) a->meeting = NSVCD_MEETS_NEVER;
  if (a->has_hit && !a->has_free) nsvcd__find_always(r);
  if (a->has_free && a->has_hit) a->meeting = NSVCD_MEETS_SOMETIMES;
  if (a->meeting == NSVCD_MEETS_UNKNOWN) return;
  a->why = NSVCD_WHY_NOTHING;
  a->open = 0;
}

// Lays a search out at base; NULL: only counts. r: the span has its parts. Returns the bytes; 0 if
// they are too many.
static size_t nsvcd__range_layout(const nsvcd__ranging *r, char *base, nsvcd__ranging **laid,
                                  void **checker) {
  uint64_t used = 0;
  const size_t row = 2 * r->span.joints + 1;
  const size_t size = nsvcd_checker_size(&r->span.scene);
  *laid = NSVCD__TAKE_ROWS(nsvcd__ranging, 1, base, &used);
  double *boxes = NSVCD__TAKE_ROWS(double, r->capacity *row, base, &used);
  *checker = nsvcd__take(base, &used, 1, size);
  if (*laid) **laid = *r;
  if (*laid) (*laid)->boxes = boxes;
  return size && used <= SIZE_MAX ? (size_t)used : 0;
}

static nsvcd_result nsvcd__range_begin(const nsvcd_checker *c, nsvcd_body_pair pair,
                                       const nsvcd_range_options *options, nsvcd__ranging *r) {
  if (!c) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = c->scene;
  if (pair.a >= scene->part_count || pair.b >= scene->part_count ||
      scene->parts[pair.a].link == scene->parts[pair.b].link)
    return NSVCD_ERROR_PAIR;
  memset(r, 0, sizeof *r);
  if (options) r->options = *options;
  nsvcd_range_options *o = &r->options;
  if (!nsvcd__is_length(o->clearance)) return NSVCD_ERROR_CLEARANCE;
  if (o->boxes > NSVCD_MAX_BOXES) return NSVCD_ERROR_COUNT;
  o->boxes = o->boxes ? o->boxes : NSVCD_MAX_BOXES;
  o->units = o->units ? o->units : NSVCD__RANGE_UNITS;
  r->capacity = o->boxes < NSVCD__KEPT_BOXES ? o->boxes + 1 : NSVCD__KEPT_BOXES;
  r->random = o->seed;
  nsvcd__span_begin(scene, pair, &r->span);
  r->answer.joints = r->span.joints;
  return NSVCD_OK;
}

NSVCDDEF const char *nsvcd_meeting_string(nsvcd_meeting meeting) {
  static const char texts[][12] = {"unknown", "never", "always", "sometimes"};
  const size_t count = sizeof texts / sizeof texts[0];
  return (size_t)meeting < count ? texts[meeting] : "no meeting";
}

NSVCDDEF size_t nsvcd_pair_range_size(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                      const nsvcd_range_options *options) {
  nsvcd__ranging r;
  nsvcd__ranging *unused;
  void *none;
  if (nsvcd__range_begin(checker, pair, options, &r)) return 0;
  return nsvcd__range_layout(&r, NULL, &unused, &none);
}

NSVCDDEF nsvcd_result nsvcd_pair_range(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                       const nsvcd_range_options *options, void *memory,
                                       size_t size, nsvcd_range_answer *answer) {
  nsvcd__ranging begun;
  nsvcd__ranging *r;
  void *own;
  nsvcd_result result = nsvcd__range_begin(checker, pair, options, &begun);
  if (result) return result;
  if (!answer) return NSVCD_ERROR_ARGUMENT;
  if (!memory || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  const size_t needed = nsvcd__range_layout(&begun, NULL, &r, &own);
  if (!needed || size < needed) return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__range_layout(&begun, (char *)memory, &r, &own);
  // its scene points into itself
  nsvcd__span_begin(checker->scene, pair, &r->span);
  const size_t own_size = nsvcd_checker_size(&r->span.scene);
  result = nsvcd_checker_open(&r->span.scene, own, own_size, &r->span.checker);
  if (result) return result;
  r->span.checker->stop = r->options.stop;
  r->span.checker->user = r->options.user;
  nsvcd__find_range(r);
  if (!r->result) *answer = r->answer;
  return r->result;
}

// ------------------------------------------------------------------------------------ robot/blends
// In: two states, positions and speeds of the joints, and limits of speed and acceleration. Out: a
// motion from one to the other in the least time of the slowest joint; each other joint takes as
// long, with the least acceleration that does.
//
// A joint speeds up, and slows down again, or the other way round; where it would be too fast in
// between, it goes on at the limit. So it is of degree 2, piece by piece.
// Source: Hauser and Ng-Thow-Hing (2010).

// of a blend: each joint has two times at which its acceleration changes
#define NSVCD__BLEND_PIECES (2 * NSVCD_MAX_JOINTS + 1)
// fractions of the limits of speed and acceleration that are asked for: the rest is for rounding
#define NSVCD__BLEND_FRACTION (1 - 1e-6)
#define NSVCD__BLEND_MOST (1 - 5e-7)
// seconds: no piece is shorter, for rounding would say what its acceleration is; changes of
// acceleration that are no farther apart than NSVCD__SAME_TIME are one
#define NSVCD__SLIVER 1e-4
#define NSVCD__SAME_TIME 1e-12

// A motion of degree 2 that is being made: `motion` has its arrays.
typedef struct nsvcd__trajectory {
  nsvcd_joint_motion motion;
  // (2 most pieces + 1, F)
  double *points;
  // (most pieces + 1)
  double *times;
} nsvcd__trajectory;

static void nsvcd__trajectory_begin(nsvcd__trajectory *t, size_t joints, const double *at) {
  const nsvcd_joint_motion motion = {0, 2, t->points, t->times};
  t->motion = motion;
  t->times[0] = 0;
  memcpy(t->points, at, joints * sizeof *at);
}

static double nsvcd__trajectory_end(const nsvcd__trajectory *t) {
  return t->times[t->motion.pieces];
}

// Adds a piece that ends at a time.
static void nsvcd__trajectory_add(nsvcd__trajectory *t, size_t joints, const double *middle,
                                  const double *end, double time) {
  double *at = t->points + (2 * t->motion.pieces + 1) * joints;
  memcpy(at, middle, joints * sizeof *at);
  memcpy(at + joints, end, joints * sizeof *at);
  t->times[++t->motion.pieces] = time;
}

// A joint in a blend: from position x0 at speed v0, acceleration a until t1, none until t2, -a
// after that.
typedef struct nsvcd__blend_joint {
  double x0, v0, a, t1, t2;
} nsvcd__blend_joint;

// The least time from position x0 and speed v0 to x1 and v1, both within the limits.
static double nsvcd__blend_time(double x0, double v0, double x1, double v1, double speed,
                                double most) {
  const double distance = x1 - x0;
  // a change of speed alone goes this far: is there more to go, or less?
  const double least = 0.5 * (v0 + v1) * fabs(v1 - v0) / most;
  const double side = distance >= least ? 1 : -1;
  const double peak2 = side * most * distance + 0.5 * (v0 * v0 + v1 * v1);
  const double peak = side * sqrt(nsvcd__max(peak2, 0));
  if (fabs(peak) <= speed) return (fabs(peak - v0) + fabs(peak - v1)) / most;
  const double fast = side * speed;
  const double changing = (speed * speed - 0.5 * (v0 * v0 + v1 * v1)) / (side * most);
  return (fabs(fast - v0) + fabs(fast - v1)) / most +
         nsvcd__max((distance - changing) / fast, 0);
}

// The blend with the least acceleration that takes this time. Returns 0 if there is none within
// the limits.
static int nsvcd__blend_solve(double x0, double v0, double x1, double v1, double speed,
                              double most, double time, nsvcd__blend_joint *out) {
  const double distance = x1 - x0;
  const double change = v1 - v0;
  // time^2 a^2 + b a - change^2 = 0: the root of the greater size
  const double b = 2 * time * (v0 + v1) - 4 * distance;
  const double root = sqrt(b * b + 4 * time * time * change * change);
  double a = -(b + (b > 0 ? root : -root)) / (2 * time * time);
  double t1 = 0.5 * time;
  if (a > 0 || a < 0) t1 += 0.5 * change / a;
  t1 = nsvcd__max(0, nsvcd__min(time, t1));
  double t2 = t1;
  const double peak = v0 + a * t1;
  if (fabs(peak) > speed) {
    const double fast = peak > 0 ? speed : -speed;
    const double up = (fast - v0) * (fast - v0) + (fast - v1) * (fast - v1);
    a = up / (2 * (fast * time - distance));
    if (!(a * fast > 0)) return 0;
    t1 = (fast - v0) / a;
    t2 = time - (fast - v1) / a;
    if (!(t1 >= 0 && t2 >= t1 && t2 <= time)) return 0;
  }
  const nsvcd__blend_joint solved = {x0, v0, a, t1, t2};
  *out = solved;
  return fabs(a) <= most;
}

// Position and speed at a time.
static void nsvcd__blend_at(const nsvcd__blend_joint *r, double t, double *x, double *v) {
  const double up = nsvcd__min(t, r->t1);
  const double even = nsvcd__max(nsvcd__min(t, r->t2) - r->t1, 0);
  const double down = nsvcd__max(t - r->t2, 0);
  const double fast = r->v0 + r->a * up;
  *x = r->x0 + (0.5 * (r->v0 + fast)) * up + fast * even + (fast - 0.5 * r->a * down) * down;
  *v = fast - r->a * down;
}

// Does a joint leave its limits in between, where it turns round? Both its ends are in them.
static int nsvcd__blend_leaves(const nsvcd_joint *joint, const nsvcd__blend_joint *r,
                               double time) {
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return 0;
  // where its speed is 0
  const double fast = r->v0 + r->a * r->t1;
  const double turns[2] = {r->a * r->v0 < 0 ? -r->v0 / r->a : 0,
                           r->a * fast > 0 ? r->t2 + fast / r->a : 0};
  for (size_t k = 0; k < 2; k++) {
    double x, v;
    const int is_there = k ? turns[k] > r->t2 && turns[k] < time : turns[k] < r->t1;
    if (!is_there || !(turns[k] > 0)) continue;
    nsvcd__blend_at(r, turns[k], &x, &v);
    if (x < joint->low || x > joint->high) return 1;
  }
  return 0;
}

// Joints and their speeds, (F).
typedef struct nsvcd__state {
  double x[NSVCD_MAX_JOINTS], v[NSVCD_MAX_JOINTS];
} nsvcd__state;

// Solves the blends of all joints. Returns the time that they take; 0 if there are none within the
// limits that take less than `longest`.
static double nsvcd__blend_joints(const nsvcd_scene *scene, const nsvcd__state *from,
                                  const nsvcd__state *to, double longest,
                                  nsvcd__blend_joint *out) {
  double time = 0;
  for (size_t j = 0; j < scene->joint_count; j++) {
    const double speed = NSVCD__BLEND_FRACTION * nsvcd__speed_of(&scene->joints[j]);
    const double most = NSVCD__BLEND_FRACTION * nsvcd__acceleration_of(&scene->joints[j]);
    const double own =
        nsvcd__blend_time(from->x[j], from->v[j], to->x[j], to->v[j], speed, most);
    time = nsvcd__max(time, own);
  }
  if (!(time < longest)) return 0;
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    const double speed = NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint);
    const double most = NSVCD__BLEND_MOST * nsvcd__acceleration_of(joint);
    if (joint->mimic) continue;
    if (!nsvcd__blend_solve(from->x[j], from->v[j], to->x[j], to->v[j], speed, most, time,
                            &out[j]) ||
        nsvcd__blend_leaves(joint, &out[j], time))
      return 0;
  }
  for (size_t j = 0; j < scene->joint_count; j++) {
    const double rate = nsvcd__rate(scene, j);
    const nsvcd__blend_joint *b = &out[nsvcd__driver(scene, j)];
    const nsvcd__blend_joint driven = {nsvcd__driven(scene, j, from->x), rate * b->v0,
                                       rate * b->a, b->t1, b->t2};
    if (scene->joints[j].mimic) out[j] = driven;
  }
  return time;
}

// Writes a blend of all joints. Returns 0 if there is none within the limits that takes less than
// `longest`, or two of its changes nearly coincide.
static int nsvcd__blend_write(const nsvcd_scene *scene, const nsvcd__state *from,
                              const nsvcd__state *to, double longest, nsvcd__trajectory *out) {
  const size_t joints = scene->joint_count;
  nsvcd__blend_joint blends[NSVCD_MAX_JOINTS];
  double changes[NSVCD__BLEND_PIECES];
  size_t count = 0;
  const double time = nsvcd__blend_joints(scene, from, to, longest, blends);
  if (!(time > 0)) return 0;
  // sorted, by insertion
  for (size_t n = 0; n <= 2 * joints; n++) {
    const double change = n == 2 * joints ? time : n % 2 ? blends[n / 2].t2 : blends[n / 2].t1;
    size_t at = count++;
    for (; at > 0 && changes[at - 1] > change; at--) changes[at] = changes[at - 1];
    changes[at] = change;
  }
  nsvcd__trajectory_begin(out, joints, from->x);
  for (size_t k = 0; k < count; k++) {
    const double before = nsvcd__trajectory_end(out);
    const double half = 0.5 * (changes[k] - before);
    const double *last = out->points + 2 * out->motion.pieces * joints;
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    if (changes[k] - before <= NSVCD__SAME_TIME) continue;
    if (changes[k] - before < NSVCD__SLIVER) return 0;
    for (size_t j = 0; j < joints; j++) {
      double v;
      nsvcd__blend_at(&blends[j], before, &end[j], &v);
      middle[j] = last[j] + half * v;
      nsvcd__blend_at(&blends[j], changes[k], &end[j], &v);
    }
    nsvcd__trajectory_add(out, joints, middle, end, changes[k]);
  }
  memcpy(out->points + 2 * out->motion.pieces * joints, to->x, joints * sizeof *to->x);
  return out->motion.pieces > 0;
}

// ------------------------------------------------------------------------------------ robot/smooth
// In: a path, a polyline that is proven. Out: a motion along it, timed, and then smooth.
//
// At first each edge begins and ends at rest. Then, again and again, two times are drawn: the
// motion between them is replaced by a blend, if that is quicker and proven. Every other time,
// where it still rests, they are drawn about a rest.
// Source: Hauser and Ng-Thow-Hing (2010).

// of a motion, at most
#define NSVCD__MOST_PIECES 2048
// seconds: half of the widest window about a rest; how often it may be halved
#define NSVCD__HALF_WINDOW 0.8
#define NSVCD__WINDOWS 6
// of the duration without obstacles: no more can be won
#define NSVCD__FAST_ENOUGH 1.001
// what a blend must win, to be worth its proof: a fraction of its own time, and, unless a rest goes
// with it, one of what the motion takes longer than without obstacles
#define NSVCD__LEAST_GAIN 1e-4
#define NSVCD__WORTHY_GAIN 0.02
// metres that the search adds to the clearance, so that the proof of the whole succeeds
#define NSVCD__SPARE 1e-4f
// check_options.finest and .work of the search
#define NSVCD__SEARCH_FINEST 5e-4f
#define NSVCD__SEARCH_WORK 1000

typedef struct nsvcd__router {
  nsvcd_checker *checker;
  const nsvcd_scene *scene;
  size_t joints;
  nsvcd_route_problem problem;
  nsvcd_route_options options;
  nsvcd_check_options check;
  uint64_t random;
  // motions are looked at, not proven; at most so many
  int is_looking;
  size_t looks;
  nsvcd__looker looker;
  // an error, which stops the search
  nsvcd_result result;
  int is_stopped;
  // turns that the trees have had; since each has grown
  size_t turn, idle[2];
  // from the start, from the goals
  nsvcd__rrt trees[2];
  // (F): the range of their roots
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  // joints that may move
  size_t moving[NSVCD_MAX_JOINTS], moving_count;
  // (G): of each root of trees[1], its goal; how many roots that has
  size_t *goals;
  size_t root_count;
  // the nodes where the trees have met
  size_t met[2];
  // (nodes of both trees + shortcuts, F): corners
  double *path;
  size_t corners;
  // (NSVCD__MOST_WAY, F)
  double *way;
  nsvcd__trajectory trajectory, other, blend;
  nsvcd_route_answer answer;
} nsvcd__router;

static double *nsvcd__corner_at(const nsvcd__router *r, size_t k) {
  return r->path + k * r->joints;
}

static double nsvcd__edge_length(const nsvcd__router *r, const double *from,
                                 const double *to) {
  return sqrt(nsvcd__distance2(from, to, r->joints));
}

// ---- proofs

// Is a motion proven free, and within the limits? answer.check says what is wrong.
static int nsvcd__prove_by(nsvcd__router *r, const nsvcd_joint_motion *motion,
                           const nsvcd_check_options *o) {
  r->answer.checks++;
  r->result = nsvcd_check(r->checker, motion, o, &r->answer.check);
  const int is_free = !r->result && nsvcd__proves_free(&r->answer.check);
  r->answer.proven += (size_t)is_free;
  if (r->result || (!is_free && o->stop && o->stop(o->user))) r->is_stopped = 1;
  return is_free;
}

// Do the axes of all cones stay in them? Else answer.check says which one does not.
static int nsvcd__motion_keeps_cones(nsvcd__router *r, const nsvcd_joint_motion *m) {
  nsvcd_check_answer *answer = &r->answer.check;
  const double start = nsvcd__piece_start(m, 0);
  const double end = nsvcd__piece_start(m, m->pieces);
  const int keeps = nsvcd__keeps_cones(r->checker, m, start, end, &r->check, answer);
  if (!keeps && answer->why == NSVCD_WHY_WORK) r->is_stopped = 1;
  return keeps;
}

// Does a motion seem free, and is it within the limits and the cones?
static int nsvcd__look_along(nsvcd__router *r, const nsvcd_joint_motion *motion) {
  const nsvcd_check_options *o = &r->check;
  if (o->stop && o->stop(o->user)) r->is_stopped = 1;
  // between two configurations within them, edges are
  for (size_t p = 0; motion->degree > 1 && p < motion->pieces; p++)
    if (nsvcd__joint_outside(r->scene, motion, p) != NSVCD_NONE) return 0;
  return !r->is_stopped && nsvcd__motion_keeps_cones(r, motion) &&
         nsvcd__seems_free(&r->looker, motion);
}

// Is a motion free, by a look or by a proof with the search's own options? Once the search is
// stopped, nothing is.
static int nsvcd__ask_motion(nsvcd__router *r, const nsvcd_joint_motion *motion) {
  if (!r->is_stopped && r->problem.stop && r->problem.stop(r->problem.user)) r->is_stopped = 1;
  if (r->is_looking) return nsvcd__look_along(r, motion);
  return !r->is_stopped && nsvcd__prove_by(r, motion, &r->check);
}

// Writes an edge. points: room for two configurations.
static nsvcd_joint_motion nsvcd__edge_motion(const nsvcd__router *r, const double *from,
                                             const double *to, double *points) {
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  memcpy(points, from, r->joints * sizeof *points);
  memcpy(points + r->joints, to, r->joints * sizeof *points);
  return motion;
}

// Of an edge that is not free, answer.check.cone says whether it leaves a cone.
static int nsvcd__ask_edge(nsvcd__router *r, const double *from, const double *to) {
  double points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = nsvcd__edge_motion(r, from, to, points);
  return nsvcd__ask_motion(r, &motion);
}

// ---- from rest to rest

// Adds pieces along an edge: speeds up, goes on, slows down, all joints in proportion.
static void nsvcd__add_edge(nsvcd__router *r, const double *from, const double *to) {
  nsvcd__trajectory *t = &r->trajectory;
  // of the fraction of the edge
  double speed = HUGE_VAL;
  double most = HUGE_VAL;
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double d = fabs(to[j] - from[j]);
    if (!(d > 0)) continue;
    speed = nsvcd__min(speed, NSVCD__BLEND_FRACTION * nsvcd__speed_of(joint) / d);
    most = nsvcd__min(most, NSVCD__BLEND_FRACTION * nsvcd__acceleration_of(joint) / d);
  }
  if (!(speed < HUGE_VAL)) return;
  const double up = nsvcd__min(speed / most, sqrt(1 / most));
  const double fast = most * up;
  const double even = (1 - fast * up) / fast;
  const int is_even = even > NSVCD__SLIVER;
  // fractions where pieces end, and how long they take
  const double first = is_even ? 0.5 * fast * up : 0.5;
  const double ends[3] = {first, is_even ? 1 - first : 0.5, 1};
  const double middles[3] = {0, 0.5, 1};
  const double lasts[3] = {is_even ? up : 1 / fast, even, is_even ? up : 1 / fast};
  for (size_t n = 0; n < 3; n += is_even ? 1 : 2) {
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < r->joints; j++) {
      middle[j] = from[j] + middles[n] * (to[j] - from[j]);
      end[j] = n == 2 ? to[j] : from[j] + ends[n] * (to[j] - from[j]);
    }
    const double time = nsvcd__trajectory_end(t) + lasts[n];
    nsvcd__trajectory_add(t, r->joints, middle, end, time);
  }
}

// A motion along the path, with a rest at each corner. Returns 0 where there are too many. A path
// of one corner becomes a motion of no pieces.
static int nsvcd__trajectory_along(nsvcd__router *r) {
  if (3 * r->corners > NSVCD__MOST_PIECES) return 0;
  nsvcd__trajectory_begin(&r->trajectory, r->joints, r->path);
  for (size_t k = 0; k + 1 < r->corners; k++)
    nsvcd__add_edge(r, nsvcd__corner_at(r, k), nsvcd__corner_at(r, k + 1));
  return 1;
}

// Is the motion at rest where a piece begins?
static int nsvcd__rests_at(const nsvcd__trajectory *t, size_t joints, size_t piece) {
  const double *at = t->points + 2 * piece * joints;
  for (size_t j = 0; j < joints; j++) {
    if (fabs(at[j + joints] - at[j]) > 1e-12 * (1 + fabs(at[j]))) return 0;
  }
  return 1;
}

// ---- smooth

// Adds a trajectory from time t0 to t1 to another one. Returns 0 where a sliver would be left, or
// there is no room.
static int nsvcd__trajectory_append(const nsvcd__trajectory *t, size_t joints, double t0,
                                    double t1, nsvcd__trajectory *out) {
  const nsvcd_joint_motion *m = &t->motion;
  for (size_t p = nsvcd__piece_at(m, t0); p < m->pieces && t->times[p] < t1; p++) {
    const double from = nsvcd__max(t0, t->times[p]);
    const double to = nsvcd__min(t1, t->times[p + 1]);
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    if (to - from <= NSVCD__SAME_TIME) continue;
    if (to - from < NSVCD__SLIVER || out->motion.pieces == NSVCD__MOST_PIECES) return 0;
    for (size_t j = 0; j < joints; j++) {
      double points[NSVCD_MAX_DEGREE + 1];
      nsvcd__joint_points(m, p, joints, j, points);
      nsvcd__cut_curve(points, 2, nsvcd__fraction_at(m, p, from),
                       nsvcd__fraction_at(m, p, to));
      middle[j] = points[1];
      end[j] = points[2];
    }
    const double time = nsvcd__trajectory_end(out) + (to - from);
    nsvcd__trajectory_add(out, joints, middle, end, time);
  }
  return 1;
}

// Replaces the trajectory from time t0 to t1 by a blend, if that is quicker by `gain` and proven.
static void nsvcd__smooth_once(nsvcd__router *r, double t0, double t1, double gain) {
  const size_t joints = r->joints;
  const nsvcd__trajectory *t = &r->trajectory;
  nsvcd__trajectory *blend = &r->blend;
  nsvcd__trajectory *out = &r->other;
  nsvcd__state from, to;
  nsvcd__joints_at_time(&t->motion, joints, t0, from.x, from.v);
  nsvcd__joints_at_time(&t->motion, joints, t1, to.x, to.v);
  if (!nsvcd__blend_write(r->scene, &from, &to, t1 - t0 - gain, blend)) return;
  nsvcd__trajectory_begin(out, joints, t->points);
  if (!nsvcd__trajectory_append(t, joints, 0, t0, out)) return;
  if (!nsvcd__trajectory_append(blend, joints, 0, nsvcd__trajectory_end(blend), out)) return;
  if (!nsvcd__trajectory_append(t, joints, t1, nsvcd__trajectory_end(t), out)) return;
  if (!nsvcd__ask_motion(r, &blend->motion)) return;
  const nsvcd__trajectory was = r->trajectory;
  r->trajectory = *out;
  *out = was;
}

static void nsvcd__smooth(nsvcd__router *r) {
  for (size_t n = 0; n < r->options.smoothings && !r->is_stopped; n++) {
    const nsvcd__trajectory *t = &r->trajectory;
    const double end = nsvcd__trajectory_end(t);
    if (end <= NSVCD__FAST_ENOUGH * r->answer.unhindered) return;
    double t0 = end * nsvcd__random(&r->random);
    double t1 = end * nsvcd__random(&r->random);
    size_t rests = 0;
    double rest = 0;
    for (size_t p = 1; p < t->motion.pieces && n % 2; p++) {
      // each as likely as the others
      if (!nsvcd__rests_at(t, r->joints, p)) continue;
      if (nsvcd__random(&r->random) * (double)++rests <= 1) rest = t->times[p];
    }
    if (rests > 0) {
      const size_t halvings = (size_t)(NSVCD__WINDOWS * nsvcd__random(&r->random));
      const double window = NSVCD__HALF_WINDOW / (double)(1 << halvings);
      t0 = nsvcd__max(0, rest - window);
      t1 = nsvcd__min(end, rest + window);
    }
    const double least = NSVCD__LEAST_GAIN * fabs(t1 - t0);
    const double worthy = NSVCD__WORTHY_GAIN * (end - r->answer.unhindered);
    const double gain = rests ? least : nsvcd__max(least, worthy);
    nsvcd__smooth_once(r, nsvcd__min(t0, t1), nsvcd__max(t0, t1), gain);
  }
}

// -------------------------------------------------------------------------------------- robot/grow
// In: a tree of a route, and where it is to grow. Out: new nodes, by edges that are free, in the
// scene's cones.
//
// Where there are cones, a configuration that is drawn is moved into them, and a tree goes on in
// steps, each moved into them anew: as far as the straight edge to it stays in them, and as long as
// that leads nearer.
// Source: CBiRRT (Berenson et al. 2009). Difference: an edge is proven to stay in the cones.

// turns after which a tree that has not grown tries along single joints
#define NSVCD__IDLE 100
// radians or metres: seven configurations in eight are drawn no farther than this from the range of
// the start and the goals
#define NSVCD__BESIDE 3.2
// the share of a cone's angle that configurations are moved to; how often a step may be halved; and
// the least share of a step by which it leads nearer
#define NSVCD__GROW_CONE 0.6
#define NSVCD__GROW_HALVINGS 6
#define NSVCD__GROW_NEARER 0.25
// looks that a proof takes as long as, about
#define NSVCD__PROOF_LOOKS 16
// corners of a way that makes a path shorter, at most
#define NSVCD__MOST_WAY 16

// A value of a joint in its limits, near the start and the goals or anywhere.
static double nsvcd__draw_joint(nsvcd__router *r, size_t j, int is_wide) {
  const nsvcd_joint *joint = &r->scene->joints[j];
  double low = r->low[j] - NSVCD__BESIDE;
  double high = r->high[j] + NSVCD__BESIDE;
  if (joint->kind != NSVCD_JOINT_CONTINUOUS) {
    low = is_wide ? joint->low : nsvcd__max(low, joint->low);
    high = is_wide ? joint->high : nsvcd__min(high, joint->high);
  }
  return low + (high - low) * nsvcd__random(&r->random);
}

// A configuration towards which a tree may grow: any; where it has not grown for long, every
// other time, one of its own nodes with one joint moved. Out of a hole the only free edges are
// often those along one joint.
static void nsvcd__draw(nsvcd__router *r, size_t side, double *out) {
  const size_t joints = r->joints;
  const nsvcd__rrt *t = &r->trees[side];
  if (r->idle[side] >= NSVCD__IDLE && r->turn / 2 % 2) {
    size_t node = (size_t)(nsvcd__random(&r->random) * (double)t->count);
    while (t->marks[node] & NSVCD__NODE_CUT) node = t->parents[node];
    const size_t joint =
        r->moving[(size_t)(nsvcd__random(&r->random) * (double)r->moving_count)];
    memcpy(out, nsvcd__node_at(t, node), joints * sizeof *out);
    out[joint] = nsvcd__draw_joint(r, joint, 1);
    return;
  }
  const int is_wide = nsvcd__random(&r->random) < 0.125;
  // what is held stays where all roots have it
  memcpy(out, r->low, joints * sizeof *out);
  for (size_t k = 0; k < r->moving_count; k++)
    out[r->moving[k]] = nsvcd__draw_joint(r, r->moving[k], is_wide);
}

// Looks, and proofs as so many.
static size_t nsvcd__spent(const nsvcd__router *r) {
  return r->looker.count + NSVCD__PROOF_LOOKS * r->answer.checks;
}

// Are there as many nodes, or tries, or looks, as are allowed?
static int nsvcd__is_at_limit(const nsvcd__router *r) {
  return r->trees[0].count + r->trees[1].count >= r->options.nodes ||
         r->answer.checks >= r->options.tries ||
         (r->is_looking && nsvcd__spent(r) >= r->looks);
}

// A motion that the cones refuse is asked about, too: else a search might not end.
static void nsvcd__count_refused(nsvcd__router *r) {
  ++*(r->is_looking ? &r->looker.count : &r->answer.checks);
  if (r->problem.stop && r->problem.stop(r->problem.user)) r->is_stopped = 1;
}

// One edge on the way from a configuration to another: no longer than options.edge, in the cones,
// free. Returns 0 if there is none, 2 if it ends there, else 1.
static int nsvcd__step_towards(nsvcd__router *r, const double *from, const double *to,
                               double *next) {
  const double length = nsvcd__edge_length(r, from, to);
  double step = nsvcd__min(length, r->options.edge);
  const size_t halvings = r->scene->cone_count ? NSVCD__GROW_HALVINGS : 0;
  for (size_t n = 0; n <= halvings; n++, step *= 0.5) {
    const int ends = step >= length;
    for (size_t j = 0; j < r->joints; j++)
      next[j] = ends ? to[j] : from[j] + step / length * (to[j] - from[j]);
    if (halvings > 0 && !ends) {
      if (!nsvcd__into_cones(r->checker, r->problem.held, NSVCD__GROW_CONE, next)) continue;
      const double left = nsvcd__edge_length(r, next, to);
      if (!(left <= length - NSVCD__GROW_NEARER * step)) continue;
    }
    if (nsvcd__ask_edge(r, from, next)) return 1 + ends;
    if (r->answer.check.cone == NSVCD_NONE) return 0;
  }
  nsvcd__count_refused(r);
  return 0;
}

// Grows a tree from its node nearest to a configuration: by one edge, or, if `is_greedy`, edge by
// edge. *node: the last new node, or the nearest one. Returns 1 if that is the configuration.
static int nsvcd__grow(nsvcd__router *r, nsvcd__rrt *t, const double *to, int is_greedy,
                       size_t *node) {
  *node = nsvcd__tree_nearest(t, to);
  for (;;) {
    double next[NSVCD_MAX_JOINTS];
    const double *from = nsvcd__node_at(t, *node);
    if (!(nsvcd__distance2(from, to, r->joints) > 0)) return 1;
    const int is_doubted = t->marks[*node] & NSVCD__NODE_DOUBTED;
    const int was = r->is_looking;
    if (is_doubted) r->is_looking = 0;
    const int ends = nsvcd__step_towards(r, from, to, next);
    r->is_looking = was;
    if (!ends || nsvcd__is_at_limit(r)) return 0;
    *node = nsvcd__tree_add(t, next, *node);
    if (is_doubted) t->marks[*node] |= NSVCD__NODE_PROVEN;
    if (ends == 2 || !is_greedy) return ends == 2;
  }
}

// A way between two configurations: an edge, or, where there are cones, some that are no longer
// than `longest` together. corners: (NSVCD__MOST_WAY, F), both ends among them. Returns how many; 0
// if none is found.
static size_t nsvcd__way_between(nsvcd__router *r, const double *from, const double *to,
                                 double longest, double *corners) {
  const size_t bytes = r->joints * sizeof *corners;
  double length = 0;
  memcpy(corners, from, bytes);
  memcpy(corners + r->joints, to, bytes);
  if (nsvcd__ask_edge(r, from, to)) return 2;
  if (r->answer.check.cone == NSVCD_NONE) return 0;
  for (size_t n = 1; n < NSVCD__MOST_WAY; n++) {
    const double *last = corners + (n - 1) * r->joints;
    double *next = corners + n * r->joints;
    const int ends = nsvcd__step_towards(r, last, to, next);
    length += nsvcd__edge_length(r, last, next);
    if (!ends || length > longest) return 0;
    if (ends == 2) return n + 1;
  }
  return 0;
}

// ------------------------------------------------------------------------------------- robot/trees
// In: a router whose trees have their roots. Out: a path from the start to a goal, through both.
//
// The smaller tree grows, and the other towards it. By looks, edges only seem to be free: those of
// a path can be proven afterwards. What hangs on one that is not free is cut off; the rest stays,
// and edges from where it began are proven at once from then on.
// Source: RRT-Connect (Kuffner and LaValle 2000), with edges that are proven, not sampled; of paths
// by looks, Bohlin and Kavraki (2000).

// Writes the path through the two nodes where the trees have met, the same configuration.
static void nsvcd__take_path(nsvcd__router *r) {
  const size_t bytes = r->joints * sizeof(double);
  const size_t from_start = r->met[0];
  const size_t from_goal = r->met[1];
  const nsvcd__rrt *start = &r->trees[0];
  const nsvcd__rrt *goal = &r->trees[1];
  size_t count = 1;
  for (size_t n = from_start; start->parents[n] != n; n = start->parents[n]) count++;
  r->corners = count;
  for (size_t n = from_start; count-- > 0; n = start->parents[n])
    memcpy(nsvcd__corner_at(r, count), nsvcd__node_at(start, n), bytes);
  size_t n = from_goal;
  while (goal->parents[n] != n) {
    n = goal->parents[n];
    memcpy(nsvcd__corner_at(r, r->corners++), nsvcd__node_at(goal, n), bytes);
  }
  r->answer.goal = r->goals[n];
}

// Tries an edge from a node of the first tree to one of the second. Returns 1 if it is free: then
// the path is found.
static int nsvcd__join(nsvcd__router *r, size_t from_start, size_t from_goal) {
  const double *to = nsvcd__node_at(&r->trees[1], from_goal);
  if (!nsvcd__ask_edge(r, nsvcd__node_at(&r->trees[0], from_start), to)) return 0;
  r->met[0] = nsvcd__tree_add(&r->trees[0], to, from_start);
  r->met[1] = from_goal;
  return 1;
}

// The trees take what is free of the caller's guess, from both ends. Returns 1 if that is a path.
static int nsvcd__take_guess(nsvcd__router *r) {
  const nsvcd_route_problem *p = &r->problem;
  size_t first = 0;
  size_t last = p->guess_count;
  size_t nodes[2] = {0, 0};
  // which goal it leads to
  if (last > 0)
    nodes[1] = nsvcd__tree_nearest(&r->trees[1], p->guess + (last - 1) * r->joints);
  for (int side = 0; side < 2; side++) {
    nsvcd__rrt *t = &r->trees[side];
    while (first < last) {
      const double *to = p->guess + (side ? last - 1 : first) * r->joints;
      if (!nsvcd__ask_edge(r, nsvcd__node_at(t, nodes[side]), to)) break;
      nodes[side] = nsvcd__tree_add(t, to, nodes[side]);
      first += side == 0;
      last -= side == 1;
    }
  }
  return first == last && nsvcd__join(r, nodes[0], nodes[1]);
}

// Grows the trees until they meet, after the guess and the straight lines. Returns 0 at a limit.
static int nsvcd__seek(nsvcd__router *r) {
  if (r->turn == 0) {
    r->turn = 2;
    if (nsvcd__take_guess(r)) return 1;
    // straight lines to the goals
    const size_t roots = r->trees[1].count;
    for (size_t g = 0; g < roots && g < r->problem.goal_count && !r->is_stopped; g++)
      if (nsvcd__join(r, 0, g)) return 1;
  }
  while (!r->is_stopped && r->moving_count > 0) {
    const size_t side = r->trees[1].count < r->trees[0].count;
    r->turn++;
    nsvcd__rrt *grown = &r->trees[side];
    double drawn[NSVCD_MAX_JOINTS];
    nsvcd__draw(r, side, drawn);
    nsvcd__follow(r->scene, 1, drawn);
    const size_t before = grown->count;
    if (nsvcd__into_cones(r->checker, r->problem.held, NSVCD__GROW_CONE, drawn))
      (void)nsvcd__grow(r, grown, drawn, 0, &r->met[side]);
    else
      nsvcd__count_refused(r);
    if (nsvcd__is_at_limit(r)) return 0;
    r->idle[side] = grown->count == before ? r->idle[side] + 1 : 0;
    if (grown->count == before) continue;
    const double *to = nsvcd__node_at(grown, r->met[side]);
    if (nsvcd__grow(r, &r->trees[1 - side], to, 1, &r->met[1 - side])) return 1;
  }
  return 0;
}

// ---- paths by looks

// Proves the edges from a root to a node, until one is not free: that is cut off.
static int nsvcd__prove_branch(nsvcd__router *r, nsvcd__rrt *t, size_t node) {
  for (;;) {
    size_t next = t->count;
    for (size_t n = node; t->parents[n] != n; n = t->parents[n])
      if (!(t->marks[n] & NSVCD__NODE_PROVEN)) next = n;
    if (next == t->count) return 1;
    const double *from = nsvcd__node_at(t, t->parents[next]);
    if (!nsvcd__ask_edge(r, from, nsvcd__node_at(t, next))) {
      if (r->is_stopped) return 0;
      t->marks[t->parents[next]] |= NSVCD__NODE_DOUBTED;
      r->idle[t == &r->trees[1]] = NSVCD__IDLE;
      nsvcd__tree_cut(t, next);
      return 0;
    }
    t->marks[next] |= NSVCD__NODE_PROVEN;
  }
}

// Proves the path where the trees have met; where it is not free, they are apart again.
static int nsvcd__prove_path(nsvcd__router *r) {
  const int was = r->is_looking;
  r->is_looking = 0;
  const int to_start = nsvcd__prove_branch(r, &r->trees[0], r->met[0]);
  const int to_goal = nsvcd__prove_branch(r, &r->trees[1], r->met[1]);
  r->is_looking = was;
  return to_start && to_goal;
}

// ------------------------------------------------------------------------------------- robot/route
// In: a start and goals. Out: a motion that is proven free, in the caller's memory.

// defaults; tries: for each node
#define NSVCD__NODES 20000
#define NSVCD__TRIES 4
#define NSVCD__SHORTCUTS 20
#define NSVCD__SMOOTHINGS 200
// times as many of both where there are cones
#define NSVCD__CONE_TRIES 3
#define NSVCD__MOST_LOOKS 200000
// of a search by looks: looks of the first, twice as many after each that finds nothing; searches
#define NSVCD__FIRST_LOOKS 4000
#define NSVCD__LOOK_SEARCHES 16
// of the balls' errors, which margins are less by after each search that finds nothing
#define NSVCD__LOOK_EASE 0.34f
// of the path between its ends: how long a way of several edges in its place may be
#define NSVCD__SHORTER 0.95
// radians or metres: corners of a path that are no farther apart are one
#define NSVCD__SAME_CORNER 1e-9

// ---- memory

static nsvcd_result nsvcd__route_check(const nsvcd_checker *checker,
                                       const nsvcd_route_problem *problem,
                                       const nsvcd_route_options *options) {
  if (!checker || !problem || !problem->start || !problem->goals) return NSVCD_ERROR_ARGUMENT;
  const size_t most = NSVCD_MAX_NODES;
  if (problem->goal_count < 1 || problem->goal_count > most) return NSVCD_ERROR_COUNT;
  if (problem->guess ? problem->guess_count > most : problem->guess_count > 0)
    return NSVCD_ERROR_COUNT;
  if (options && (options->nodes > most || !(options->edge >= 0))) return NSVCD_ERROR_ROUTE;
  if (options && options->shortcuts > most && options->shortcuts != NSVCD_NONE)
    return NSVCD_ERROR_ROUTE;
  const size_t joints = checker->scene->joint_count;
  const double *rows[3] = {problem->start, problem->goals, problem->guess};
  const size_t counts[3] = {1, problem->goal_count, problem->guess_count};
  for (size_t n = 0; n < 3; n++) {
    if (!nsvcd__are_numbers(rows[n], counts[n] * joints)) return NSVCD_ERROR_VALUE;
    if (!nsvcd__follows(checker->scene, counts[n], rows[n])) return NSVCD_ERROR_MIMIC;
    for (size_t k = 0; k < counts[n] * joints && problem->held; k++) {
      const double off = rows[n][k] - problem->start[k % joints];
      if (checker->scene->joints[k % joints].mimic) continue;
      if (problem->held[k % joints] && (off > 0 || off < 0)) return NSVCD_ERROR_HELD;
    }
  }
  return NSVCD_OK;
}

static void nsvcd__trajectory_take(nsvcd__trajectory *t, char *base, uint64_t *used,
                                   size_t pieces, size_t joints) {
  t->points = NSVCD__TAKE_ROWS(double, (2 * pieces + 1) * joints, base, used);
  t->times = NSVCD__TAKE_ROWS(double, pieces + 1, base, used);
}

// Lays a router out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes; 0 if they are more than can be counted.
static size_t nsvcd__router_layout(const nsvcd_checker *checker,
                                   const nsvcd_route_problem *problem,
                                   const nsvcd_route_options *options, char *base,
                                   nsvcd__router **router) {
  nsvcd__router counted;
  uint64_t used = 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd__router));
  nsvcd__router *r = at ? (nsvcd__router *)at : &counted;
  memset(r, 0, sizeof *r);
  if (options) r->options = *options;
  nsvcd_route_options *o = &r->options;
  o->nodes = o->nodes ? o->nodes : NSVCD__NODES;
  o->tries = o->tries ? o->tries : NSVCD__TRIES * o->nodes;
  o->edge = o->edge > 0 ? o->edge : 1;
  const size_t more = checker->scene->cone_count ? NSVCD__CONE_TRIES : 1;
  if (!o->shortcuts) o->shortcuts = more * NSVCD__SHORTCUTS;
  if (!o->smoothings) o->smoothings = more * NSVCD__SMOOTHINGS;
  if (o->shortcuts == NSVCD_NONE) o->shortcuts = 0;
  if (o->smoothings == NSVCD_NONE) o->smoothings = 0;
  o->looks = o->looks ? o->looks : NSVCD__MOST_LOOKS;
  if (o->looks == NSVCD_NONE || !nsvcd__can_look(checker)) o->looks = 0;
  const size_t joints = checker->scene->joint_count;
  // the caller's configurations do not count as nodes
  const size_t nodes = o->nodes + problem->goal_count + problem->guess_count + 1;
  for (size_t k = 0; k < 2; k++) {
    nsvcd__rrt *t = &r->trees[k];
    t->joints = joints;
    t->points = NSVCD__TAKE_ROWS(double, (nodes * joints), base, &used);
    t->parents = NSVCD__TAKE_ROWS(uint32_t, nodes, base, &used);
    t->next = NSVCD__TAKE_ROWS(uint32_t, nodes, base, &used);
    t->marks = NSVCD__TAKE_ROWS(uint8_t, nodes, base, &used);
    t->cells = NSVCD__TAKE_ROWS(nsvcd__cell, 2 * nodes, base, &used);
  }
  r->goals = NSVCD__TAKE_ROWS(size_t, problem->goal_count, base, &used);
  // a shortcut from an edge to the next adds a corner, or those of a way in the cones
  const size_t most = checker->scene->cone_count ? NSVCD__MOST_WAY : 1;
  const size_t rows = 2 * nodes + most * o->shortcuts;
  r->path = (double *)nsvcd__take(base, &used, rows, joints * sizeof(double));
  r->way = NSVCD__TAKE_ROWS(double, (NSVCD__MOST_WAY * joints), base, &used);
  nsvcd__trajectory_take(&r->trajectory, base, &used, NSVCD__MOST_PIECES, joints);
  nsvcd__trajectory_take(&r->other, base, &used, NSVCD__MOST_PIECES, joints);
  nsvcd__trajectory_take(&r->blend, base, &used, NSVCD__BLEND_PIECES, joints);
  if (o->looks) nsvcd__looker_take(checker->scene, base, &used, &r->looker);
  *router = (nsvcd__router *)at;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_route_size(const nsvcd_checker *checker,
                                 const nsvcd_route_problem *problem,
                                 const nsvcd_route_options *options) {
  nsvcd__router *unused;
  if (nsvcd__route_check(checker, problem, options)) return 0;
  return nsvcd__router_layout(checker, problem, options, NULL, &unused);
}

// ---- shortcuts

// The point that is this far along the path. Returns the corner before it.
static size_t nsvcd__path_at(const nsvcd__router *r, double along, double *at) {
  size_t k = 0;
  double length;
  for (;; k++) {
    length = nsvcd__edge_length(r, nsvcd__corner_at(r, k), nsvcd__corner_at(r, k + 1));
    if (k + 2 >= r->corners || along <= length) break;
    along -= length;
  }
  const double *from = nsvcd__corner_at(r, k);
  const double *to = nsvcd__corner_at(r, k + 1);
  const double fraction = length > 0 ? nsvcd__min(along / length, 1) : 0;
  for (size_t j = 0; j < r->joints; j++) at[j] = from[j] + fraction * (to[j] - from[j]);
  return k;
}

// Replaces the path between two points drawn on it by an edge, again and again, where that is free.
static void nsvcd__shorten(nsvcd__router *r) {
  const size_t bytes = r->joints * sizeof(double);
  for (size_t n = 0; n < r->options.shortcuts && r->corners > 2 && !r->is_stopped; n++) {
    double at[2][NSVCD_MAX_JOINTS];
    double length = 0;
    for (size_t k = 0; k + 1 < r->corners; k++)
      length += nsvcd__edge_length(r, nsvcd__corner_at(r, k), nsvcd__corner_at(r, k + 1));
    const double a = length * nsvcd__random(&r->random);
    const double b = length * nsvcd__random(&r->random);
    const size_t first = nsvcd__path_at(r, nsvcd__min(a, b), at[0]);
    const size_t last = nsvcd__path_at(r, nsvcd__max(a, b), at[1]);
    // on one edge nothing is won, and the path would grow by corners
    if (first == last) continue;
    const double longest = NSVCD__SHORTER * fabs(b - a);
    const size_t count = nsvcd__way_between(r, at[0], at[1], longest, r->way);
    if (!count) continue;
    // corners first + 1 to last make way for these
    const size_t rest = r->corners - (last + 1);
    const size_t next = first + 1 + count;
    memmove(nsvcd__corner_at(r, next), nsvcd__corner_at(r, last + 1), rest * bytes);
    memcpy(nsvcd__corner_at(r, first + 1), r->way, count * bytes);
    r->corners = next + rest;
  }
}

// Drops corners that are nearly at the one before: of so short an edge rounding would say what its
// acceleration is. The timed motion is proven as a whole.
static void nsvcd__simplify_path(nsvcd__router *r) {
  const size_t bytes = r->joints * sizeof(double);
  const double least2 = NSVCD__SAME_CORNER * NSVCD__SAME_CORNER;
  const double *last = nsvcd__corner_at(r, r->corners - 1);
  size_t kept = 1;
  for (size_t k = 1; k < r->corners; k++) {
    const double *at = nsvcd__corner_at(r, k);
    if (nsvcd__distance2(nsvcd__corner_at(r, kept - 1), at, r->joints) < least2) continue;
    memmove(nsvcd__corner_at(r, kept++), at, bytes);
  }
  // the end stays where it is
  memmove(nsvcd__corner_at(r, kept - 1), last, bytes);
  r->corners = kept;
}

// ---- a route

NSVCDDEF const char *nsvcd_route_status_string(nsvcd_route_status status) {
  static const char texts[][48] = {"found", "no path found with so many nodes or tries",
                                   "stopped", "start not free", "no goal free"};
  const size_t count = sizeof texts / sizeof texts[0];
  return (size_t)status < count ? texts[status] : "not a status";
}

// Copies a configuration, clamped to the limits where only rounding has it out. Is it free? That is
// tried with the search's clearance, then with the caller's, each with the search's work, then with
// all; edges from there are proven with what was enough.
static int nsvcd__take_in(nsvcd__router *r, const double *at, double *out) {
  const nsvcd_joint_motion motion = {0, 0, out, NULL};
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double error = nsvcd__limit_error(joint);
    out[j] = at[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    if (at[j] < joint->low && at[j] >= joint->low - error) out[j] = joint->low;
    if (at[j] > joint->high && at[j] <= joint->high + error) out[j] = joint->high;
  }
  nsvcd__follow(r->scene, 1, out);
  const nsvcd_check_options was = r->check;
  for (size_t n = 0; n < 4; n++) {
    r->check = was;
    if (n % 2) r->check.clearance = r->options.clearance;
    if (n / 2) r->check.work = 0;
    if (nsvcd__ask_motion(r, &motion)) return 1;
    // no work makes that free
    const nsvcd_check_answer *found = &r->answer.check;
    if (found->joint != NSVCD_NONE || (n % 2 && found->verdict == NSVCD_HIT)) break;
  }
  r->check = was;
  return 0;
}

// Adds a root to a tree, and to the range of all roots.
static void nsvcd__plant_root(nsvcd__router *r, nsvcd__rrt *t, const double *at) {
  const int is_first = r->trees[0].count == 0;
  for (size_t j = 0; j < r->joints; j++) {
    r->low[j] = is_first ? at[j] : nsvcd__min(r->low[j], at[j]);
    r->high[j] = is_first ? at[j] : nsvcd__max(r->high[j], at[j]);
  }
  nsvcd__tree_add(t, at, t->count);
}

// Plants the roots of the trees. Sets the status where there are none.
static void nsvcd__plant(nsvcd__router *r) {
  const double full_turn = 6.283185307179586;
  double at[NSVCD_MAX_JOINTS];
  r->answer.status = NSVCD_ROUTE_START;
  if (!nsvcd__take_in(r, r->problem.start, at)) return;
  nsvcd__plant_root(r, &r->trees[0], at);
  for (size_t g = 0; g < r->problem.goal_count; g++) {
    if (!nsvcd__take_in(r, r->problem.goals + g * r->joints, at)) continue;
    // as near as whole turns bring it
    for (size_t j = 0; j < r->joints; j++) {
      const double turns = floor((at[j] - r->trees[0].points[j]) / full_turn + 0.5);
      if (r->scene->joints[j].kind == NSVCD_JOINT_CONTINUOUS) at[j] -= full_turn * turns;
    }
    nsvcd__follow(r->scene, 1, at);
    r->goals[r->trees[1].count] = g;
    nsvcd__plant_root(r, &r->trees[1], at);
  }
  r->answer.status = r->trees[1].count ? NSVCD_ROUTE_LIMIT : NSVCD_ROUTE_GOAL;
}

// Makes a motion of the path and proves all of it: smooth, else with a rest at each corner. What
// looks found is tried smooth only.
static void nsvcd__time_path(nsvcd__router *r) {
  nsvcd_route_answer *answer = &r->answer;
  const nsvcd__trajectory *t = &r->trajectory;
  const double *last = nsvcd__corner_at(r, r->corners - 1);
  // a search before this one may have ended at another goal
  answer->unhindered = 0;
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double time = nsvcd__blend_time(r->path[j], 0, last[j], 0, nsvcd__speed_of(joint),
                                          nsvcd__acceleration_of(joint));
    answer->unhindered = nsvcd__max(answer->unhindered, time);
  }
  nsvcd_check_options whole;
  memset(&whole, 0, sizeof whole);
  whole.clearance = r->options.clearance;
  whole.stop = r->check.stop;
  whole.user = r->check.user;
  int is_free = 0;
  for (int rests = 0; rests < 2 - r->is_looking && !is_free; rests++) {
    if (!nsvcd__trajectory_along(r)) return;
    if (!rests) nsvcd__smooth(r);
    nsvcd__follow(r->scene, 2 * t->motion.pieces + 1, t->points);
    // also when the caller has stopped the search: what it found by then is proven
    is_free = !r->result && nsvcd__prove_by(r, &t->motion, &whole);
  }
  if (!is_free) return;
  answer->status = NSVCD_ROUTE_FOUND;
  answer->motion = t->motion;
  answer->duration = nsvcd__trajectory_end(t);
  for (size_t p = 1; p < t->motion.pieces; p++)
    answer->stops += (size_t)nsvcd__rests_at(t, r->joints, p);
}

// Makes a motion of the path where the trees have met.
static void nsvcd__make_motion(nsvcd__router *r) {
  nsvcd__take_path(r);
  nsvcd__shorten(r);
  nsvcd__simplify_path(r);
  nsvcd__time_path(r);
}

// Seeks a path and makes a motion of it. Looks are believed until one is refuted: from then on
// paths are proven first.
static void nsvcd__find_motion(nsvcd__router *r) {
  const int is_looking = r->is_looking;
  int is_believed = 1;
  while (nsvcd__seek(r)) {
    if (!is_believed && !nsvcd__prove_path(r)) continue;
    nsvcd__make_motion(r);
    if (!is_looking || r->answer.status == NSVCD_ROUTE_FOUND) return;
    is_believed = 0;
    if (!nsvcd__prove_path(r)) continue;
    r->is_looking = 0;
    nsvcd__make_motion(r);
    r->is_looking = is_looking;
    return;
  }
}

// Takes the trees back to their roots.
static void nsvcd__replant(nsvcd__router *r) {
  const size_t roots[2] = {1, r->root_count};
  for (size_t k = 0; k < 2; k++) {
    nsvcd__rrt *t = &r->trees[k];
    t->count = t->cell_count = 0;
    for (size_t n = 0; n < roots[k]; n++) {
      double at[NSVCD_MAX_JOINTS];
      memcpy(at, nsvcd__node_at(t, n), r->joints * sizeof *at);
      nsvcd__tree_add(t, at, n);
    }
    r->idle[k] = 0;
  }
  r->turn = 0;
  r->random = r->options.seed;
}

// Searches by looks until a motion is proven. Where nothing is found, the next search looks longer,
// and less strictly.
static void nsvcd__search_by_looks(nsvcd__router *r) {
  nsvcd__looker *k = &r->looker;
  nsvcd__looker_begin(r->checker, &r->check, k);
  r->is_looking = 1;
  for (size_t n = 0; n < NSVCD__LOOK_SEARCHES && !r->is_stopped; n++) {
    const double ease = nsvcd__min(1, (double)NSVCD__LOOK_EASE * (double)n);
    const size_t most = nsvcd__spent(r) + ((size_t)NSVCD__FIRST_LOOKS << n);
    nsvcd__replant(r);
    nsvcd__set_margins(k, r->options.clearance, (float)ease);
    for (size_t side = 0; side < 2; side++)
      for (size_t i = 0; i < r->trees[side].count; i++)
        nsvcd__look_past(k, nsvcd__node_at(&r->trees[side], i));
    r->looks = most < r->options.looks ? most : r->options.looks;
    r->random += n;
    nsvcd__find_motion(r);
    if (r->answer.status == NSVCD_ROUTE_FOUND || nsvcd__spent(r) >= r->options.looks) break;
  }
  r->is_looking = 0;
  r->answer.looks = k->count;
}

NSVCDDEF nsvcd_result nsvcd_route(nsvcd_checker *checker, const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, void *memory,
                                  size_t size, nsvcd_route_answer *answer) {
  nsvcd__router *r;
  const nsvcd_result result = nsvcd__route_check(checker, problem, options);
  if (result) return result;
  if (!answer) return NSVCD_ERROR_ARGUMENT;
  if (options && (!nsvcd__is_finite(options->clearance) || options->clearance < 0))
    return NSVCD_ERROR_CLEARANCE;
  const size_t needed = nsvcd__router_layout(checker, problem, options, NULL, &r);
  if (!memory || !nsvcd__is_aligned(memory) || !needed || size < needed)
    return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__router_layout(checker, problem, options, (char *)memory, &r);
  r->checker = checker;
  r->scene = checker->scene;
  r->joints = checker->scene->joint_count;
  r->problem = *problem;
  r->random = r->options.seed;
  r->check.clearance = r->options.clearance + NSVCD__SPARE;
  r->check.finest = NSVCD__SEARCH_FINEST;
  r->check.work = NSVCD__SEARCH_WORK;
  r->check.stop = problem->abandon;
  r->check.user = problem->user;
  for (size_t j = 0; j < r->joints; j++)
    if (!r->scene->joints[j].mimic && !(problem->held && problem->held[j]))
      r->moving[r->moving_count++] = j;
  nsvcd__plant(r);
  r->root_count = r->trees[1].count;
  if (r->root_count > 0 && r->options.looks) nsvcd__search_by_looks(r);
  if (r->root_count > 0 && r->answer.status != NSVCD_ROUTE_FOUND && !r->is_stopped) {
    nsvcd__replant(r);
    nsvcd__find_motion(r);
  }
  if (r->result) return r->result;
  if (r->is_stopped && r->answer.status != NSVCD_ROUTE_FOUND)
    r->answer.status = NSVCD_ROUTE_STOPPED;
  r->answer.nodes = r->trees[0].count + r->trees[1].count;
  *answer = r->answer;
  return NSVCD_OK;
}

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // NEURALSVCD_ROBOT_IMPLEMENTATION

// Licence: LICENSE, or the end of neuralsvcd.h.
