// neuralsvcd_world.h - v0.3.0 - one body against all others: a world for games and simulations
// SPDX-License-Identifier: MIT
//
// nsvcd_world_sweep answers a question about one mover and all that it comes near; and
// nsvcd_world_slide moves a body for a frame: it goes, loses the speed that points into what it
// meets, and goes on, and no two bodies ever overlap. It stands on the public functions of
// neuralsvcd.h. In ONE C or C++ file:
//
//   #define NEURALSVCD_WORLD_IMPLEMENTATION
//   #include "extras/neuralsvcd_world.h"
//
// CONTENTS
//
#ifndef NEURALSVCD_WORLD_H
#define NEURALSVCD_WORLD_H
#ifndef NEURALSVCD_H  // include it first where it stands elsewhere
#include "header.h"
#endif
#ifdef NSVCD_NO_PROOF
#error "neuralsvcd_world.h: proofs are all it does, and NSVCD_NO_PROOF leaves them out"
#endif

// ================================================================== interface: what a program sees
#ifdef __cplusplus
extern "C" {
#endif
#include "interface/worlds.h"  // a world, questions about one body and all others, slides
#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_WORLD_H

// ================================================================================== IMPLEMENTATION
#if defined(NEURALSVCD_WORLD_IMPLEMENTATION) && !defined(NEURALSVCD_WORLD_IMPLEMENTED)
#define NEURALSVCD_WORLD_IMPLEMENTED
#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // of ground, not all is needed
#endif

// ====================================================================== ground: numbers and memory
#include "ground/compiler.h"   // what is asked of the compiler; libc and libm
#include "ground/angles.h"     // sines and angles, by libm or computed here
#include "ground/bits.h"       // bits and sizes
#include "ground/valid.h"      // is what a caller hands over in order?
#include "ground/points.h"     // vectors of three, of floats and of doubles
#include "ground/rotations.h"  // quaternions and matrices, of floats and of doubles
#include "ground/motions.h"    // between two poses: lines and slerps, in double
#include "ground/memory.h"     // the allocator; the rows of a workspace

// ============================================================== world: one body against all others
#include "world/boxes.h"     // boxes about bodies on their ways
#include "world/tree.h"      // boxes that meet a box
#include "world/world.h"     // bodies at their places; who may meet whom
#include "world/ask.h"       // a mover against all that it comes near
#include "world/respond.h"   // what contacts leave of a speed
#include "world/ways.h"      // contacts, and ways as far as they are free
#include "world/walk.h"      // characters: grounds, walls and steps
#include "world/slide.h"     // a frame of a body
#include "world/momentum.h"  // what bodies that meet give each other
#include "world/carry.h"     // who goes along with lifts
#include "world/step.h"      // a frame of all
#include "world/mass.h"      // the mass of a mesh

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // NEURALSVCD_WORLD_IMPLEMENTATION

// Licence: LICENSE, or the end of neuralsvcd.h.
