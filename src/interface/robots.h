// In: a robot among obstacles, and a motion of its joints. Out: is that motion free?
//
// The motion is proven free as the joints make it, at all times, and not only at samples. A sweep
// (nsvcd_sweep) moves a part in a line and a slerp from one sample of the motion to the next. The
// joints move it along a curve, which deviates from the sweep by no more than a bound that follows
// from the joints (robot/deviation.h). If the sweep is free with that bound as a clearance, the
// curve is free.
#pragma once
#include "queries.h"

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
