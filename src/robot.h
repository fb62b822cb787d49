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
// CONTENTS
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
#include "header.h"
#endif
#ifdef NSVCD_NO_PROOF
#error "neuralsvcd_robot.h: proofs are all it does, and NSVCD_NO_PROOF leaves them out"
#endif

// ================================================================== interface: what a program sees
#ifdef __cplusplus
extern "C" {
#endif
#include "interface/robots.h"  // joints, parts, checks of motions; nsvcd_check
#include "interface/merges.h"  // motions on clocks of their own, as one; nsvcd_merge_motions
#include "interface/configurations.h"  // one configuration: pairs that are near, a way out
#include "interface/ranges.h"          // do two parts ever meet, or always? nsvcd_pair_range
#include "interface/reaches.h"  // configurations that have a tool at a target; nsvcd_reach
#include "interface/routes.h"   // a start and goals; nsvcd_route
#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_ROBOT_H

#if defined(NEURALSVCD_CERTIFY_H) && !defined(NEURALSVCD_ROBOT_PAIRS_H)
#define NEURALSVCD_ROBOT_PAIRS_H
#ifdef __cplusplus
extern "C" {
#endif
#include "interface/pairs.h"  // a certificate of a pair of parts; nsvcd_certify_pair
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
#include "ground/compiler.h"   // what is asked of the compiler; libc and libm
#include "ground/angles.h"     // sines and angles, by libm or computed here
#include "ground/bits.h"       // bits and sizes
#include "ground/digests.h"    // digests of words
#include "ground/valid.h"      // is what a caller hands over in order?
#include "ground/points.h"     // vectors of three, of floats and of doubles
#include "ground/rotations.h"  // quaternions and matrices, of floats and of doubles
#include "ground/motions.h"    // between two poses: lines and slerps, in double
#include "ground/random.h"     // random numbers
#include "ground/memory.h"     // the allocator; the rows of a workspace

// ============================================================ robot: is a motion of joints free?
#include "robot/chain.h"       // links, joints and frames: where everything is
#include "robot/mimics.h"      // joints that others drive
#include "robot/steps.h"       // what the joints do between two times
#include "robot/allowances.h"  // when a pair may touch
#include "robot/deviation.h"   // how far a part leaves its sweep between two samples
#include "robot/checker.h"     // the checker of a scene
#include "robot/cones.h"       // does an axis stay within its cone?
#include "robot/samples.h"     // configurations of a motion, and boxes about the parts in them
#include "robot/local_queries.h"   // two parts, in the frame of one of them
#include "robot/check.h"           // is a motion of the joints free?
#include "robot/merge.h"           // motions on clocks of their own, as one
#include "robot/looks.h"           // does a motion seem free?
#include "robot/proofs.h"          // certificates of pairs
#include "robot/rrt.h"             // trees of configurations, and the nearest node
#include "robot/configurations.h"  // proximities, the nearest free one, pairs that can meet
#include "robot/cholesky.h"        // linear equations
#include "robot/reach.h"           // configurations that have a tool at a target
#include "robot/spans.h"           // two parts, and the joints between them
#include "robot/meetings.h"        // configurations in which two parts meet, and do not
#include "robot/partings.h"        // does a plane part two parts in a box of values?
#include "robot/ranges.h"          // do two parts meet never, always or sometimes?
#include "robot/blends.h"  // from one state to another, within limits of speed and acceleration
#include "robot/smooth.h"  // a path, timed, then smooth
#include "robot/grow.h"    // where a tree grows, and edge by edge, in the cones
#include "robot/trees.h"   // two trees of edges, until they meet
#include "robot/route.h"   // a path, shortened, as a motion that is proven

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // NEURALSVCD_ROBOT_IMPLEMENTATION

// Licence: LICENSE, or the end of neuralsvcd.h.
