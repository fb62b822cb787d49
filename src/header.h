// neuralsvcd.h - v0.3.0 - does this body, moving along this trajectory, hit that body?
// SPDX-License-Identifier: MIT
//
// The answer is a proof: a witness (two triangles that meet, and when) or a certificate that the
// surfaces never do, at any time, rotation included. Where memory is short or a gradient is needed,
// a small neural network estimates the answer instead (NeuralSVCD: Son, Jung, Kim, CoRL 2025). Its
// weights, trained by this project, are in weights.h. C99 or C++11, libc and libm, nothing else.
// MIT licence, weights included: LICENSE, or the end of this file.
//
// In ONE C or C++ file, with weights.h beside this header:
//
//   #define NEURALSVCD_IMPLEMENTATION
//   #include "neuralsvcd.h"
//
// Everywhere else, include the header alone. With NSVCD_NO_NETWORK, weights.h is not needed: there
// is only the proof.
//
// This is a whole program, which asks a question:
//
//   #define NEURALSVCD_IMPLEMENTATION
//   #include "neuralsvcd.h"
//   #include <stdio.h>
//   #include <stdlib.h>
//
//   int main(void) {
//     nsvcd_mesh mesh;
//     const nsvcd_body *mug;  // encoded once per mesh
//     nsvcd_result result = nsvcd_obj_load("mug.obj", NULL, &mesh, NULL);
//     if (!result) result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &mug);
//     if (result) return fprintf(stderr, "mug.obj: %s\n", nsvcd_result_string(result)), 1;
//
//     const nsvcd_pose path[2] = {{{0, 0, 0.5f}, {0, 0, 0, 1}}, {{0, 0, -0.5f}, {0, 0, 0, 1}}};
//     nsvcd_question question = {0};  // zero is the default of everything but the bodies
//     question.a.body = mug;
//     question.a.poses = path;
//     question.a.count = 2;
//     question.b.body = mug;  // the same mesh, twice as large, rests at the origin
//     question.b.scale = 2;
//     question.ask = NSVCD_ASK_FIRST;  // the first contact; the default, HIT, is yes or no
//     question.to = 0.001f;            // metres
//
//     nsvcd_answer answer;
//     const size_t size = nsvcd_sweep_workspace_size(&question);
//     if (nsvcd_sweep(&question, malloc(size), size, &answer)) return 1;
//     if (answer.verdict == NSVCD_HIT) printf("hits at t = %g\n", (double)answer.time.high);
//     return 0;
//   }
//
// A larger program is examples/quickstart.c.
//
// FUNCTIONS, each with its contract below
//   nsvcd_obj_load        a file -> a mesh; so do nsvcd_stl_load and nsvcd_mesh_load
//   nsvcd_mesh_of_faces   faces in memory -> a mesh; nsvcd_mesh_of_heights: a height field
//   nsvcd_mesh_hull       points -> their convex hull, a mesh
//   nsvcd_encode          a mesh -> a body; nsvcd_encode_sphere, _capsule, _box, _cloud: a shape
//   nsvcd_body_load       bytes -> a body, every byte checked
//   nsvcd_body_describe   a body -> its size, box, triangles; is it closed?
//   nsvcd_look            do two bodies meet, in 16 places at once? an opinion, by balls
//   nsvcd_sweep           a question -> an answer; nsvcd_sweep_batch: many
//   nsvcd_contacts        two bodies at rest -> where they are near each other, on all sides
//   nsvcd_sweep_gradient  a question -> the network's answer, and its derivatives by the poses
//   nsvcd_plan            a start and a goal -> a smooth motion of joints that hits nothing
//   extras/neuralsvcd_robot.h    a robot's joints: is their motion free? Find one that is
//   extras/neuralsvcd_world.h    one body against all others: may it move? Slide it for a frame
//   extras/neuralsvcd_certify.h  an answer -> bytes that prove it, which others can check
//
// OPTIONS, defined before the implementation is included
//   NSVCD_STATIC      all functions are static, in a file that has the implementation
//   NSVCD_NO_STDIO    no file access: no nsvcd_obj_load and the like; nsvcd_obj_parse stays
//   NSVCD_NO_READERS  no readers of OBJ, STL and faces
//   NSVCD_NO_ENCODER  no readers, no other function that makes a mesh, no nsvcd_encode:
//                     bodies come from nsvcd_body_load
//   NSVCD_NO_PROOF    the network alone: triangles are neither stored nor read
//   NSVCD_NO_NETWORK  the proof alone: no weights.h, no gradient, no optimizer
//   NSVCD_NO_SMALL, NSVCD_NO_BASE   no such decoder; the default is the largest that is left
//   NSVCD_NO_INT8, NSVCD_NO_FLOAT   no such arithmetic of the decoders; the default is float, if it
//                                   is left
//   NSVCD_NO_GRADIENT    no nsvcd_sweep_gradient, no optimizer
//   NSVCD_NO_OPTIMIZER   no nsvcd_plan, no nsvcd_spline
//   NSVCD_NO_SIMD     plain C in place of AVX-512, AVX2 with FMA, SSE2, NEON and SIMD128
//   NSVCD_ONE_PATH    the same bits on all machines: see DETERMINISM
//   NSVCD_NO_DISPATCH    only the vectors that the compiler's flags allow, on x86-64 by default
//                     SSE2. Without this option, a build for SSE2 also holds queries for AVX2 and
//                     AVX-512, and the processor decides
//
// CONVENTIONS
//   Units are metres and radians, axes right-handed. Quaternions are x y z w, of unit length. Time
//   is in [0,1]. Arrays are row-major, and their shape stands beside the pointer: (count, 3).
//   Triangles are counter-clockwise seen from outside. The winding gives the normals, and flipping
//   it costs accuracy. Options are structs in which zero means the default.
//
//   A function that can fail returns an nsvcd_result, 0 on success. On failure it leaves its
//   outputs as they were. (Functions that return a size, and nsvcd_body_patch, return 0 instead.
//   nsvcd_spline writes nothing.) Functions are re-entrant, and there are no global variables.
//   Memory is the caller's, or comes from the allocator that a function takes.
//
// The queries below say what an answer is worth, and what is known of numeric limits and of
// determinism. The bodies say which meshes count as closed. tests/bench/RESULTS.md has what was
// measured.
#ifndef NEURALSVCD_H
#define NEURALSVCD_H
#define NSVCD__FROM_ROOMS  // only here: neuralsvcd.h, which is made of this file, goes without

// ================================================================== interface: what a program sees
#include "interface/options.h"  // the version, and what is compiled
#ifdef __cplusplus
extern "C" {
#endif
#include "interface/results.h"   // result codes, the caller's allocator
#include "interface/meshes.h"    // OBJ and STL, faces, parts of a mesh
#include "interface/bodies.h"    // encoding, loading, scaling, facts
#include "interface/looks.h"     // two bodies in 16 places; nsvcd_look
#include "interface/queries.h"   // movers, questions, answers; nsvcd_sweep and its kin
#include "interface/contacts.h"  // what is near at rest; nsvcd_contacts
#include "interface/plans.h"     // splines, planning problems; nsvcd_plan

#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_H

// ================================================================================== IMPLEMENTATION
// Made from the files of src/, which are to be edited in its place: CONTRIBUTING.md has a map, and
// says where to go for a change.
//
// CONTENTS
//
// GLOSSARY of what is this library's own; the rest is the field's
//   patch             a part of the surface around one point; N of them make a body
//   group, tile       16 neighbouring patches; up to 32 groups that are searched together
//   level             spheres over 16 groups each, over 16 of these, ...; a body that has them
//   piece, entry      a triangle, or a part of one, that belongs to one patch; the same as stored
//   latent            what the network keeps of a patch: vectors of degree 1 and 2, and scalars
//   geometry          what the proof keeps of a body: slabs, hulls and entries
//   slab, hull        of a patch: its extent along a direction and across it; up to 16 vertices
//   margin            how far a patch may stick out of its hull
//   moving, fixed     the bodies of a query: all is computed in the frame of the fixed one
//   segment           a part of a motion, of up to 20 degrees of turn; 64 at most
//   interval          a segment or a part of one, as the proof bounds it; in motion/choice, a part
//                     of a long motion; in search/intervals, a time in which two balls meet
//   try               a search of a larger interval with little work
//   bend, origin_bend how far a point leaves its chord, the straight line through a segment: per
//                     metre from the moving origin, by the rotation, and with that origin
//   lane, block       one of 16 numbers that are worked on together; 16 segments, or 16 entries
//   candidate         two patches, and the interval in which their balls meet
//   ranker            the tiny decoder, which picks the candidates that the chosen decoder sees
//   patch pair, triangle pair   two patches, two entries, that the proof has yet to separate
//   track, arc        the poses of one body in time, its keyframes; the motion between two of them
//   tick              the unit of time: keyframes are at whole numbers of ticks
//   work              the units that question.work counts
//
// entry/processor includes this file again for AVX2 and for AVX-512, with NSVCD__ISA defined: then
// only the rooms that use vectors are compiled, under names of their own.
#if defined(NEURALSVCD_IMPLEMENTATION) && \
    (!defined(NEURALSVCD_IMPLEMENTED) || defined(NSVCD__ISA))
#define NEURALSVCD_IMPLEMENTED

#ifndef NSVCD__ISA
// ====================================================================== ground: numbers and memory
#include "ground/compiler.h"   // what is asked of the compiler; libc and libm
#include "ground/strings.h"    // the texts of codes and statuses
#include "ground/angles.h"     // sines and angles, by libm or computed here
#include "ground/bits.h"       // bits and sizes
#include "ground/valid.h"      // checks of what a caller passes
#include "ground/points.h"     // vectors of three, of floats and of doubles
#include "ground/rotations.h"  // quaternions and matrices, of floats and of doubles
#include "ground/motions.h"    // between two poses: lines and slerps, in double
#include "ground/triangles.h"  // two triangles: where they meet, or are nearest
#include "ground/spheres.h"    // spheres and slabs, as bodies store them
#include "ground/random.h"     // random numbers
#include "ground/memory.h"     // the allocator; the rows of a workspace
#include "ground/slices.h"     // how many of 16 lanes a register holds

// ======================================================================= mesh: files and triangles
#include "mesh/mesh.h"      // checks; cuts at a box
#include "mesh/hull.h"      // the convex hull of points
#include "mesh/heights.h"   // height fields
#include "mesh/weld.h"      // vertices at the same position
#include "mesh/polygons.h"  // one face into triangles
#include "mesh/faces.h"     // faces of any number of corners into a mesh
#include "mesh/text.h"      // tokens and numbers of a text, metres
#include "mesh/obj.h"       // Wavefront OBJ
#include "mesh/stl.h"       // STL, binary and text
#include "mesh/files.h"     // either, with an origin and a scale

// =========================================================== patches: the surface divided in parts
#include "patches/samples.h"   // oriented points of the surface, in proportion to area
#include "patches/clusters.h"  // farthest point sampling, then Lloyd's algorithm
#include "patches/covering.h"  // balls that cover the surface; patches as a whole
#include "patches/topology.h"  // welded vertices, components, which of them are closed
#include "patches/edges.h"     // which triangles share an edge; corners that are joined
#include "patches/solids.h"    // what still encloses something despite its flaws
#include "patches/regions.h"   // a large mesh in regions, each with its own patches

// ======================================================= surface: the shape of each patch, bounded
#include "surface/pieces.h"   // triangles cut by the cells of the centres
#include "surface/runs.h"     // points, segments and triangles, in runs of neighbours
#include "surface/balls.h"    // the smallest ball around points
#include "surface/slabs.h"    // a direction in which points are thin
#include "surface/hulls.h"    // up to 16 vertices around a patch
#include "surface/sorted.h"   // pieces by patch; eight extremes of each, for the network
#include "surface/surface.h"  // of each patch a ball, a slab, a hull, its triangles

// ====================================================== encoder: what the network keeps of a patch
#include "encoder/model.h"    // does weights.h fit?
#include "encoder/encoder.h"  // a patch -> its latent

// ================================================================================== body: the blob
#include "body/body.h"        // balls in groups of 16, and levels of spheres above
#include "body/covering.h"    // what a body of triangles begins with: counts, a box, balls
#include "body/traversal.h"   // the groups whose spheres pass a test
#include "body/geometry.h"    // what the proof reads: slabs, hulls, triangles
#include "body/voxels.h"      // a mesh as a grid of cells
#include "body/ball_cover.h"  // a few balls that cover a mesh, for looks
#include "body/trust.h"       // is a blob sound? load it, describe it
#include "body/scale.h"       // a body, scaled
#include "body/write.h"       // a surface -> what the proof reads
#include "body/encode.h"      // nsvcd_encode
#include "body/shapes.h"      // spheres, capsules, boxes, clouds

// ======================================== motion: where bodies are, and the memory of their search
#include "motion/motion.h"     // the moving body's poses as the fixed one sees them
#include "motion/workspace.h"  // the memory of a search: segments, chords, tiles, candidates
#include "motion/choice.h"     // how a motion is cut into segments, a long one into intervals

// ============================================================== proof: the theorem, and its state
#include "proof/schedule.h"   // what a proof may take, and how much of it
#include "proof/near_list.h"  // triangle pairs that are near each other at rest
#include "proof/proof.h"      // the theorem; what a proof is asked, knows and remembers

// ============================================================= task: a question, and what it needs
#include "task/facts.h"  // what a decoder sees of a pair; the tape of its derivative
#include "task/task.h"   // a question that has been checked, and its memory

#endif  // NSVCD__ISA

// ===================================================================== lanes: 16 numbers at a time
#include "lanes/lanes.h"  // AVX-512, AVX2, SSE2, NEON, SIMD128 or plain C
#include "lanes/turns.h"  // rotations, lane by lane

// =================================================== look: do two bodies seem to meet? an opinion
#include "look/look.h"  // balls against balls, patches or a box, in 16 places

// ================================================================ segments: 16 parts of a motion
#include "segments/segments.h"   // chords, and how far a point deviates from them
#include "segments/chords.h"     // spheres on chords, and which others they meet
#include "segments/self_test.h"  // are these vectors right?

// ================================================================== search: which patches may meet
#include "search/planes.h"     // patches that a plane between their extremes separates
#include "search/intervals.h"  // when the balls of two patches meet, for the network
#include "search/search.h"     // which groups and patches meet, and in which segments

// ========================================== triangles: two triangles over an interval, in double
#include "triangles/poses.h"           // poses in double
#include "triangles/motion_bounds.h"   // an interval of time, and how far points deviate in it
#include "triangles/triangle_pairs.h"  // two triangles, in double: separated, or in contact
#include "triangles/touches.h"         // how deep triangles that touch are, and what undoes it
#include "triangles/near.h"            // a list of what is near each other at rest

// ======================================================== separate: until when surfaces stay apart
#include "separate/slabs.h"           // planes along the slabs of patches and of groups
#include "separate/hulls.h"           // planes between hulls
#include "separate/blocks.h"          // 16 triangles at a time
#include "separate/witnesses.h"       // two triangles that meet at one time
#include "separate/patch_pairs.h"     // two patches: separated, or in contact
#include "separate/containment.h"     // whether one body is inside the other, by rays
#include "separate/in_order.h"        // a small mover: what it comes to first
#include "separate/loop.h"            // every patch pair that a search finds is resolved
#include "separate/distance_bound.h"  // a distance that two vertices have: the first bound

// ============================================================================= network: an opinion
#include "network/latent_rotation.h"  // Wigner matrices; latents rotated by them
#include "network/winding_number.h"   // whether one body is inside the other, estimated
#include "network/pairs.h"            // candidates -> pairs of patches, and how they move
#include "network/invariants.h"       // pairs -> invariants, the inputs of the decoder
#include "network/decoder.h"          // invariants -> logits and distances, in float or int8
#include "network/opinion.h"          // candidates, ranked, and a logit for the best of them
#include "network/tape.h"             // what the derivative of that is made of

#ifndef NSVCD__ISA
// =============================================== entry: the kernels of each set, and the best ones
#include "entry/processor.h"  // SSE2, AVX2 or AVX-512: the processor decides

// ======================================================== gradient: of distance or logit, by poses
#include "gradient/by_pair.h"   // by the decoder's inputs, and by the pair
#include "gradient/gradient.h"  // by the poses, and by the times of contact

// =============================================================== query: a question, and its answer
#include "query/looks.h"     // two bodies in 16 places
#include "query/verdict.h"   // of one search: do they meet, when first, how near
#include "query/long.h"      // the same of a motion of any length
#include "query/leave.h"     // pushing out of a contact, and how deep it is
#include "query/normals.h"   // a contact's normal, against the motion
#include "query/manifold.h"  // contact points, the farthest along directions
#include "query/supports.h"  // up to four contact points: where to seek them, and which
#include "query/by_proof.h"  // an answer by proof
#include "query/question.h"  // check, choose who moves, lay out the workspace, answer
#include "query/contacts.h"  // where bodies at rest are near each other, on all sides

// ================================================================ plan: a motion that hits nothing
#include "plan/spline.h"   // quintic Hermite
#include "plan/problem.h"  // a planning problem in the caller's workspace
#include "plan/culling.h"  // which bodies may meet when; what a collision costs
#include "plan/cost.h"     // control points -> cost, and its derivative
#include "plan/explore.h"  // MPPI
#include "plan/refine.h"   // L-BFGS, with bundled gradients
#include "plan/plan.h"     // several seeds, and the last check

#endif  // NSVCD__ISA
#endif  // NEURALSVCD_IMPLEMENTATION

// MIT License
//
// Copyright (c) 2026 the neuralsvcd.h authors
//
// The trained weights in weights.h (and the golden vectors in tests/data) are part of the software
// and covered by this licence. They were trained on procedural shapes made by this project only.
//
// Permission is hereby granted, free of charge, to any person obtaining a copy of this software and
// associated documentation files (the "Software"), to deal in the Software without restriction,
// including without limitation the rights to use, copy, modify, merge, publish, distribute,
// sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is
// furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all copies or
// substantial portions of the Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT
// NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
// NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
// DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
// OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
