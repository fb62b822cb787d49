// In: a robot among obstacles, and a motion of its joints. Out: is it free, as the joints make it?
//
// Between two samples of a joint motion a link leaves the line and the slerp that nsvcd_sweep is
// about. By how much, at most, follows from the joints (robot/deviate): with that as clearance the
// sweep proves the joints' own motion, at all times.
#pragma once
#include "queries.h"

// of a piece of a motion
#define NSVCD_MAX_DEGREE 5
#define NSVCD_MAX_PARTS 65536

typedef enum nsvcd_joint_kind {
  NSVCD_JOINT_REVOLUTE = 0,  // turns about its axis, within limits
  NSVCD_JOINT_CONTINUOUS,    // turns without limits
  NSVCD_JOINT_PRISMATIC      // slides along its axis, within limits
} nsvcd_joint_kind;

// Joint i carries link i + 1. Link 0 is the world.
typedef struct nsvcd_joint {
  nsvcd_joint_kind kind;
  // the link that the joint is on, i at most
  uint32_t parent;
  // of the joint's frame, in that link
  nsvcd_pose origin;
  // in its frame; any length but 0
  float axis[3];
  // radians or metres; not read of CONTINUOUS
  double low, high;
  // radians or metres, per s and per s^2: what a route keeps to, and nothing else reads; 0: 1
  double speed, acceleration;
} nsvcd_joint;

// A body on a link. What is on link 0 rests.
typedef struct nsvcd_part {
  const nsvcd_body *body;
  uint32_t link;
  // in its link
  nsvcd_pose pose;
  // NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; 0: 1
  float scale;
} nsvcd_part;

// Who moves how, and who can meet whom. Nothing else is looked at.
typedef struct nsvcd_scene {
  // (F), up to NSVCD_MAX_JOINTS
  const nsvcd_joint *joints;
  size_t joint_count;
  // (B), up to NSVCD_MAX_PARTS
  const nsvcd_part *parts;
  size_t part_count;
  // (P) of parts; on links that differ
  const nsvcd_body_pair *pairs;
  size_t pair_count;
} nsvcd_scene;

// A motion of the joints: pieces one after another, each a Bezier curve of this degree in time,
// which begins where the one before ends. A polyline has degree 1. Where there are no pieces it is
// one configuration, at which the robot rests.
typedef struct nsvcd_joint_motion {
  size_t pieces;
  // 1..NSVCD_MAX_DEGREE
  size_t degree;
  // (pieces degree + 1, F), radians or metres
  const double *points;
  // (pieces + 1), seconds, rising; NULL: each piece takes one. Without jumps of speed a motion is
  // asked about in fewer sweeps
  const double *times;
} nsvcd_joint_motion;

// The joints at a time of a motion.
//   motion     not NULL, as nsvcd_check takes it
//   joints     F
//   time       seconds, as motion->times has them; taken into the motion
//   out        (F), not NULL
NSVCDDEF void nsvcd_motion_at(const nsvcd_joint_motion *motion, size_t joints, double time,
                              double *out);

// What is zero is the default.
typedef struct nsvcd_check_options {
  // metres: to come as near as this is a hit
  float clearance;
  // metres: no sample is put where a link leaves its sweep by less than this; 10 um
  float finest;
  // units that the proof of a pair in a piece may take; NSVCD_DEFAULT_WORK
  size_t work;
  // asked before each question about a pair; not 0 ends the check, UNDECIDED for want of work. May
  // be NULL
  int (*stop)(void *user);
  void *user;
} nsvcd_check_options;

typedef struct nsvcd_check_answer {
  // FREE: at no time of the motion do two parts of a pair come within the clearance. HIT: two do,
  // or one is inside of the other, in the configuration that is named
  nsvcd_verdict verdict;
  nsvcd_why why;
  // of the scene's pairs, and where in the motion: of a HIT, which need not be the motion's first,
  // or of what is UNDECIDED. NSVCD_NONE where there is none
  size_t pair, piece;
  // of the piece, in [0,1]
  double fraction;
  // of a HIT, as nsvcd_answer.nearest has it; its time is 0
  nsvcd_contact contact;
  // a joint that leaves its limits somewhere, NSVCD_NONE: none does
  size_t joint;
  // configurations that links were placed at, and questions asked
  size_t placed, sweeps;
} nsvcd_check_answer;

// A scene that has been looked at, in the caller's memory.
typedef struct nsvcd_checker nsvcd_checker;

// Bytes that nsvcd_checker_open needs; 0 if the scene is refused.
NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene);

// Makes a checker of a scene: what moves what, and how far points of a part can be from each axis.
//   scene      not NULL; it and all that it points to stays as it is as long as the checker is used
//   memory     (size) bytes, nsvcd_checker_size(scene) or more, not NULL, aligned to
//              NSVCD_ALIGNMENT
//   checker    not NULL; left as it was on failure
//   allocates  nothing
//   threads    each with a checker of its own
//   errors     ARGUMENT (NULL), COUNT, of joints JOINT, AXIS, LIMITS, SPEED, of parts BODY,
//              VERSION, TRIANGLES, LINK, SCALE, of both POSE, QUATERNION, PAIR (or of what never
//              moves apart), WORKSPACE
NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker);

// Where the parts are, for a picture, say: poses in the world are rounded to float, which far from
// its origin is more than what nsvcd_check answers to.
//   joints     (F), radians or metres; not looked at: NaN gives poses that are none
//   poses      (B), in the world
NSVCDDEF void nsvcd_forward_kinematics(const nsvcd_checker *checker, const double *joints,
                                       nsvcd_pose *poses);

// Is a motion free?
//   checker    not NULL; where things are hit is remembered: it is asked there first
//   motion     not NULL
//   options    NULL: the defaults
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, DEGREE, VALUE (points not finite or beyond NSVCD_MAX_COORDINATE), TIMES,
//              CLEARANCE, FINEST
//   source     this library: robot/deviate; slerps and lines against joints, by second derivatives
//
// What FREE says holds for the joints' own motion, with all joint values and frames exact, and
// bodies as nsvcd_sweep says. A HIT is one of the configuration named, to what a pose in float is
// off: 1e-7 of the distance between the two parts' origins and of the
// bodies' extents. How far the robot stands from the world's origin does not matter, as each pair
// is asked about in the frame of one of its parts.
NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer);
