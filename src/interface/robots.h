// In: a robot among obstacles, and a motion of its joints. Out: is it free, as the joints make it?
//
// nsvcd_sweep is about a line and a slerp between two poses. Between two samples of a joint motion
// a link deviates from these, by a bound that follows from the joints (robot/deviation.h): with
// that as clearance the sweep proves the joints' own motion, at all times.
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
  // the joint's frame, in that link
  nsvcd_pose origin;
  // in the joint's frame; any length but 0
  float axis[3];
  // limits, radians or metres; unused if CONTINUOUS
  double low, high;
  // limits of routes only: radians or metres, per s and per s^2; 0: 1
  double speed, acceleration;
} nsvcd_joint;

// A body on a link. On link 0 it rests.
typedef struct nsvcd_part {
  const nsvcd_body *body;
  uint32_t link;
  // in its link
  nsvcd_pose pose;
  // NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; 0: 1
  float scale;
} nsvcd_part;

// A robot and its obstacles. Only the pairs named here are checked.
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

// A motion of the joints: pieces one after another, each a Bezier curve of this degree in time that
// begins where the one before ends. A polyline has degree 1. Without pieces it is one
// configuration, in which the robot rests.
typedef struct nsvcd_joint_motion {
  size_t pieces;
  // 1..NSVCD_MAX_DEGREE
  size_t degree;
  // (pieces degree + 1, F), radians or metres
  const double *points;
  // (pieces + 1), seconds, rising; NULL: each piece takes one. A motion whose speed does not jump
  // takes fewer sweeps
  const double *times;
} nsvcd_joint_motion;

// The joints at a time of a motion.
//   motion     not NULL, as nsvcd_check takes it
//   joints     F
//   time       seconds, as motion->times has them; clamped to the motion
//   out        (F), not NULL
NSVCDDEF void nsvcd_motion_at(const nsvcd_joint_motion *motion, size_t joints, double time,
                              double *out);

// Zero means the default.
typedef struct nsvcd_check_options {
  // metres: parts that come within this of each other are a hit
  float clearance;
  // metres: steps in which links deviate from their sweeps by less are not cut further; 10 um
  float finest;
  // units for each proof of a pair; NSVCD_DEFAULT_WORK
  size_t work;
  // called before each question about a pair; if it returns other than 0 the check ends UNDECIDED,
  // NSVCD_WHY_WORK. May be NULL
  int (*stop)(void *user);
  void *user;
} nsvcd_check_options;

typedef struct nsvcd_check_answer {
  // FREE: at no time of the motion do two parts of a pair come within the clearance. HIT: in the
  // configuration that is named two do, or one is inside of the other
  nsvcd_verdict verdict;
  nsvcd_why why;
  // where the HIT is, which need not be the motion's first, or what is UNDECIDED: one of the
  // scene's pairs, and a piece of the motion. NSVCD_NONE if there is none
  size_t pair, piece;
  // of the piece, in [0,1]
  double fraction;
  // of a HIT, as nsvcd_answer.nearest has it; its time is 0
  nsvcd_contact contact;
  // a joint that leaves its limits somewhere; NSVCD_NONE: none does
  size_t joint;
  // configurations that parts were placed in, and questions asked
  size_t placed, sweeps;
} nsvcd_check_answer;

// A scene, prepared for checks, in the caller's memory.
typedef struct nsvcd_checker nsvcd_checker;

// Bytes that nsvcd_checker_open needs; 0 if the scene is refused.
NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene);

// Makes a checker of a scene.
//   scene      not NULL; it and all that it points to must not change while the checker is used
//   memory     (size) bytes, nsvcd_checker_size(scene) or more, not NULL, aligned to
//              NSVCD_ALIGNMENT
//   checker    not NULL; left as it was on failure
//   allocates  nothing
//   threads    each with a checker of its own
//   errors     ARGUMENT (NULL), COUNT, of joints JOINT, AXIS, LIMITS, SPEED, of parts BODY,
//              VERSION, TRIANGLES, LINK, SCALE, of both POSE, QUATERNION, PAIR (also of two parts
//              on one link), WORKSPACE
NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker);

// Where the parts are, for a picture, say. Poses in the world are rounded to float: far from its
// origin that is coarser than what nsvcd_check computes with.
//   joints     (F), radians or metres; not checked
//   poses      (B), in the world
NSVCDDEF void nsvcd_forward_kinematics(const nsvcd_checker *checker, const double *joints,
                                       nsvcd_pose *poses);

// Is a motion free?
//   checker    not NULL; it remembers which pairs were hit, and asks about them first
//   motion     not NULL
//   options    NULL: the defaults
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, DEGREE, VALUE (points not finite or beyond NSVCD_MAX_COORDINATE), TIMES,
//              CLEARANCE, FINEST
//   source     this library: robot/deviation.h, slerps and lines against joints, by second
//              derivatives
//
// FREE holds for the joints' own motion, with exact joint values and frames, and bodies as
// nsvcd_sweep has them. A HIT is in the configuration named, up to the rounding of a pose to float:
// 1e-7 of the distance between the two parts' origins and of the bodies' extents. Each pair is
// asked about in the frame of one of its parts, so the robot may be far from the world's origin.
NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer);
