// neuralsvcd_certify.h - v0.3.0 - an answer, and bytes that prove it to others
// SPDX-License-Identifier: MIT
//
// nsvcd_certify proves an answer of nsvcd_sweep once more, by other means, and writes the proof as
// bytes. Whoever has the meshes can check them with examples/verify, which shares nothing with this
// library. It stands on the public functions of neuralsvcd.h. In ONE C or C++ file:
//
//   #define NEURALSVCD_CERTIFY_IMPLEMENTATION
//   #include "extras/neuralsvcd_certify.h"
//
// CONTENTS
//
// GLOSSARY
//   tree, node   boxes over a mesh's triangles; one of them, and its run of triangles
//   certificate  bytes that prove an answer: a traversal of two trees and of time, and rays
#ifndef NEURALSVCD_CERTIFY_H
#define NEURALSVCD_CERTIFY_H
#ifndef NEURALSVCD_H  // include it first where it stands elsewhere
#include "header.h"
#endif

// ================================================================== interface: what a program sees
#ifdef __cplusplus
extern "C" {
#endif
#include "interface/certificates.h"  // a mesh's tree; a proof as bytes; nsvcd_certify
#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_CERTIFY_H

// ================================================================================== IMPLEMENTATION
#if defined(NEURALSVCD_CERTIFY_IMPLEMENTATION) && !defined(NEURALSVCD_CERTIFY_IMPLEMENTED)
#define NEURALSVCD_CERTIFY_IMPLEMENTED
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
#include "ground/triangles.h"  // two triangles: where they meet, or are nearest
#include "ground/spheres.h"    // spheres and slabs, as bodies store them
#include "ground/random.h"     // random numbers
#include "ground/memory.h"     // the allocator; the rows of a workspace

// ===================================================== certificate: a proof that others can check
#include "certificate/tree.h"       // boxes over triangles, connected components
#include "certificate/models.h"     // where a body is, how far points leave their chords
#include "certificate/planes.h"     // a plane that separates two nodes for an interval of time
#include "certificate/rays.h"       // what a ray crosses
#include "certificate/traversal.h"  // the traversal, and its bits
#include "certificate/certify.h"    // what is inside; answers

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // NEURALSVCD_CERTIFY_IMPLEMENTATION

// Licence: LICENSE, or the end of neuralsvcd.h.
