// In: motions of some of the joints, each on a clock of its own: two arms, vehicles, a belt. Out:
// one motion of all joints, for nsvcd_check, which finds the first conflict with options.to_time.
#pragma once
#include "robots.h"

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
