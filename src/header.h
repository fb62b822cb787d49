// neuralsvcd.h - v0.3.0 - does this body, moving along this trajectory, hit that body?
// SPDX-License-Identifier: MIT
//
// The answer is proven: a witness (two triangles that meet, and when) or a certificate that the
// surfaces never do, at any time, rotation included. Where memory is short, or a gradient is
// needed, a small neural network answers instead (NeuralSVCD: Son, Jung, Kim, CoRL 2025), whose
// weights, trained by this project, are in weights.h. C99 or C++11, libc and libm, nothing else.
// MIT licence (LICENSE), which covers the weights too.
//
// Do this in ONE C or C++ file, with weights.h beside this header; include the header alone
// everywhere else:
//
//   #define NEURALSVCD_IMPLEMENTATION
//   #include "neuralsvcd.h"
//
// With NSVCD_NO_NETWORK defined before that the proof is all there is, and weights.h is not needed.
//
// Ask a question, a program as it stands:
//
//   #define NEURALSVCD_IMPLEMENTATION
//   #include "neuralsvcd.h"
//   #include <stdio.h>
//   #include <stdlib.h>
//
//   int main(void) {
//     nsvcd_mesh mesh;
//     const nsvcd_body *mug;  // once per mesh
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
//     question.ask = NSVCD_ASK_FIRST;  // and when first: the default, HIT, tells of any contact
//     question.to = 0.001f;            // metres
//
//     nsvcd_answer answer;
//     const size_t size = nsvcd_sweep_workspace_size(&question);
//     if (nsvcd_sweep(&question, malloc(size), size, &answer)) return 1;
//     if (answer.verdict == NSVCD_HIT) printf("hits at t = %g\n", (double)answer.time.high);
//     return 0;
//   }
//
// Or plan a motion that hits nothing: nsvcd_plan, below. Two headers stand on this one: for robots,
// whose joints move bodies, extras/neuralsvcd_robot.h; and for answers that others can check,
// extras/neuralsvcd_certify.h.
//
// What can fail returns a nsvcd_result: 0 is success, and on failure the outputs are left as they
// were. Exceptions are sizes and nsvcd_body_patch, which return 0 where there is none, and
// nsvcd_spline, which then writes nothing. examples/quickstart.c is a larger program.
//
// OPTIONS, defined before the implementation is included
//   NSVCD_STATIC      all functions static, in a file that has the implementation
//   NSVCD_NO_STDIO    no file access: nsvcd_obj_load goes, nsvcd_obj_parse stays
//   NSVCD_NO_OBJ      no OBJ and STL reader at all
//   NSVCD_NO_ENCODER  no nsvcd_encode, no nsvcd_mesh_cut and no OBJ reader: bodies come from
//                     nsvcd_body_load
//   NSVCD_NO_PROOF    no proof: the network answers; triangles are neither stored nor looked at
//   NSVCD_NO_NETWORK  no network, and weights.h is not needed: the proof alone; no gradient, no
//                     optimizer
//   NSVCD_NO_SMALL, NSVCD_NO_BASE   without these decoders; the default is the largest that is left
//   NSVCD_NO_GRADIENT no nsvcd_sweep_gradient, and no optimizer
//   NSVCD_NO_OPTIMIZER  no trajectory optimizer
//   NSVCD_NO_INT8, NSVCD_NO_FLOAT   without this arithmetic of the decoders; without float, int8 is
//                                   the default
//   NSVCD_NO_SIMD     plain C where there are AVX-512, AVX2 with FMA, SSE2, NEON or SIMD128
//   NSVCD_ONE_PATH    the same bits everywhere: see DETERMINISM
//   NSVCD_NO_DISPATCH on x86-64 what the compiler's flags allow, SSE2 by default; without it a
//                     build for SSE2 holds queries for AVX2 and AVX-512 too, and the processor
//                     decides
//
// CONVENTIONS
//   Metres, radians, right-handed; quaternions x y z w of unit length; time in [0,1]; arrays
//   row-major with their shape beside the pointer. Meshes are triangles, counter-clockwise seen
//   from outside: the winding gives the normals, and flipping it costs accuracy. Options are
//   structs whose zero value means the defaults. Functions are re-entrant, there are no global
//   variables, and memory is the caller's, or, in the functions that take an allocator, comes from
//   that.
//
// WHAT AN ANSWER IS WORTH
//   By proof, the default, FREE and HIT are facts, not opinions; the theorem stands in proof/proof.
//   It is about the surfaces of the two meshes and the motion as described at nsvcd_sweep, and is
//   tested by replaying certificates in double precision (tests/test_proof.c). UNDECIDED says that
//   surfaces come within 1e-9 of all lengths without meeting (of coarse bodies: within what these
//   are off, nsvcd_body_facts.quantization_error), that of eight rays none could tell whether one
//   is inside the other, that one seems to be inside of what is nearly a solid
//   (nsvcd_encode_options.open), or that the work allowed was not enough; then the network's
//   opinion is added where it has one.
//   A component of a mesh is closed if every edge has its reverse, whichever way it is wound as a
//   whole. What does no harm to that is mended, or rather not looked at: faces that are there twice
//   or turned round, fins, walls within, slivers, and gaps between corners that are no farther
//   apart than a ten-thousandth of the diagonal of the mesh's box, nor than a hundredth of the
//   longest edge at either. (What is thinner than such a gap may slip through it.) What is still
//   open encloses nothing for certain: nsvcd_body_facts tells of it. By the network all is an
//   opinion, whose measured error rates are in tests/bench/RESULTS.md. Where bodies of 0.1 to 0.4 m
//   come within a millimetre of each other it is wrong in two to six of a hundred answers: where
//   that harms, ask for a proof. What is inside is an estimate, a winding number of patches:
//   reliable for closed meshes.
//
// NUMERIC ROBUSTNESS, as measured by `make race`, `make bench`, tests/test_proof.c and
// tests/bench/extremes.sh
//   A query computes in float32, but with triangle pairs and with what is inside of what in
//   double.
//   Range         coordinates up to NSVCD_MAX_COORDINATE; bodies from NSVCD_MIN_RADIUS, below which
//                 squares underflow. Proofs are tested from 3e-11 to 3e5 m.
//   Quantum       a stored triangle is off by this: a few micrometres at most on bodies of 0.3 m.
//   Rounding      proofs allow for NSVCD__ROUNDING, two millionths, of the distances and extents
//                 involved: 2 um for bodies of 0.3 m, 80 um where one measures 20 m. So much room,
//                 and little more, must be between surfaces that are to be certified free.
//   Far away      positions are taken relative to the fixed body first: a scene 10 km from the
//                 origin loses what its own coordinates lose, about 1 mm. All is computed in the
//                 frame of one body, the one that rests or is the larger, in units of its scale.
//   Resolution    the network's limit: a patch must not be much larger than the clearance in
//                 question. A body of 5 cm against one of 20 m, with 256 patches each, is judged
//                 right in 62 % of problems near contact (RESULTS.md, *mixed*): cut the large mesh
//                 to what the motion can reach (nsvcd_mesh_cut). For the proof, the size of patches
//                 decides only what an answer costs.
//   Bad numbers   NaN and infinity are refused on their bits, also under -ffast-math.
//
// DETERMINISM
//   One binary on one processor gives the same blob of a mesh, the same answer to a question and
//   the same plan, to the bit, whatever the workspace held, and in any thread. Only what
//   nsvcd_sweep_batch answers may depend on the question before.
//   Another compiler, other flags, another processor where that decides on vectors, and another
//   libm round otherwise. Of the same blobs, what one of these proves no other refutes: by the
//   theorem each verdict of a proof is true. But one may leave undecided what another proves, and
//   times, points, patches and work differ.
//   Logits differ, and by more than rounding: the search ends at the first pair that is clear, and
//   a pair near that bound, or near another in rank, lets another pair or another decoder answer.
//   So the network's verdict may differ, where logits are near 0 or that of the ranker near its
//   bounds of +-3. The same holds for bodies that two builds encode, and for plans.
//   Joints (nsvcd_plan, neuralsvcd_robot.h) are placed by libm's sines.
//   With NSVCD_ONE_PATH blobs without latents and answers by proof are the same to the bit with
//   SSE2, AVX2, AVX-512, NEON, SIMD128 and plain C, so that two machines replay a game alike: the
//   same operations in the same order, no products fused into sums, sines and angles of this
//   header's own. gcc fuses where it is told neither -std=c99 or the like nor -ffp-contract=off,
//   clang with -ffp-contract=fast: then nsvcd_self_test says BUILD. It costs 4 to 14 %
//   (`make bench-one-path`).
//
// CONTENTS
//
// GLOSSARY
//   patch             a part of the surface about a representative point; N of them make a body
//   sample            a point of the surface, with its normal, drawn to find the patches
//   piece             a triangle, or a part of one, that belongs to one patch
//   ball              of a patch: a sphere that contains it
//   group             16 neighbouring patches
//   level             of spheres: over 16 groups each, over 16 of these, ...; and a large body,
//                     which has such levels
//   tile              up to 32 groups of a body that are searched together
//   lane, slice       one of 16 numbers that are worked on together; those that fill a register
//   block             16 segments of a motion, or 16 triangles of a patch, one in each lane
//   latent            what the encoder makes of a patch: vectors of degree 1 and 2, and scalars
//   moving, fixed     the bodies of a query: all is computed in the frame of the fixed one, which
//                     is also said to rest
//   segment           a part of the motion, up to 20 degrees of turn; 64 at most. The planner has
//                     its own: see plan/problem
//   interval          a part of a long motion, which is searched by itself; in search/intervals, a
//                     time in which two balls meet
//   try               a search of a larger interval with few units
//   chord             of a point: the straight line from its start to its end in a segment
//   deviation         how far a point may leave its chord: by the rotation, per metre from the
//                     moving origin (bend), and as that origin does (origin bend)
//   candidate         two patches and a contact interval, in which their balls meet
//   pair              two patches, as the decoder sees them
//   ranker            the tiny decoder, which chooses the candidates that the chosen one sees
//   patch pair        two patches that the proof has yet to separate in a segment
//   triangle pair     two listed triangles, one of each body
//   slab              of a patch: what it reaches along a normal, and across
//   hull, margin       of a patch: 16 vertices at most, and how far the surface sticks out
//   entry           a triangle, or a part of one, that a patch stores
//   geometry            what a body stores for the proof: slabs, hulls, entries
//   quantization error           how far a coarse triangle may be off the mesh's
//   interval              a segment, or a part of one, as the proof bounds its motion
//   keyframe, arc     when one of the poses given is reached; the motion from one to the next
//   tick              the unit of a motion's time: every keyframe is at a whole number of ticks
//   work              units that a proof takes
//   twist             how the moving body goes at a time: a velocity and an angular velocity
#ifndef NEURALSVCD_H
#define NEURALSVCD_H
#define NSVCD__FROM_ROOMS  // only here: neuralsvcd.h, which is made of this file, goes without

// ================================================================== interface: what a program sees
#include "interface/options.h"  // what is compiled; the version
#ifdef __cplusplus
extern "C" {
#endif
#include "interface/results.h"  // codes, what they say, the caller's allocator
#include "interface/meshes.h"   // OBJ files, parts of a mesh
#include "interface/bodies.h"   // encoding, loading, scaling, facts
#include "interface/queries.h"  // movers, options, answers; nsvcd_sweep and its kin
#include "interface/plans.h"    // splines, planning problems; nsvcd_plan

#ifdef __cplusplus
}
#endif
#endif  // NEURALSVCD_H

// ================================================================================== IMPLEMENTATION
// Where entry/processor takes this file in once more, for AVX2 and for AVX-512, NSVCD__ISA is
// defined: then only those rooms are compiled that use vectors, under names of their own.
#if defined(NEURALSVCD_IMPLEMENTATION) && \
    (!defined(NEURALSVCD_IMPLEMENTED) || defined(NSVCD__ISA))
#define NEURALSVCD_IMPLEMENTED

#ifndef NSVCD__ISA
// ====================================================================== ground: numbers and memory
#include "ground/compiler.h"   // what is asked of the compiler; libc and libm
#include "ground/strings.h"    // what codes and statuses say
#include "ground/angles.h"     // sines and angles, by libm or computed here
#include "ground/bits.h"       // bits and sizes
#include "ground/valid.h"      // is what a caller hands over in order?
#include "ground/points.h"     // vectors of three, of floats and of doubles
#include "ground/rotations.h"  // quaternions and matrices, of floats and of doubles
#include "ground/triangles.h"  // two triangles: where they meet, or are nearest
#include "ground/spheres.h"    // spheres and slabs, as bodies store them
#include "ground/random.h"     // random numbers
#include "ground/memory.h"     // the allocator; the rows of a workspace
#include "ground/slices.h"     // how many of 16 lanes a register holds

// ======================================================================= mesh: files and triangles
#include "mesh/mesh.h"      // checks, cuts at a box
#include "mesh/polygons.h"  // polygons into triangles
#include "mesh/faces.h"     // faces of any number of corners
#include "mesh/obj.h"       // Wavefront OBJ
#include "mesh/stl.h"       // STL, binary and text
#include "mesh/files.h"     // either, of a map or in millimetres

// ======================================================================== patches: a mesh in parts
#include "patches/samples.h"   // points of the surface, in equal share
#include "patches/clusters.h"  // farthest point sampling, then Lloyd's algorithm
#include "patches/covering.h"  // balls that cover the surface; patches as a whole
#include "patches/topology.h"  // welded vertices, components, which of them are closed
#include "patches/solids.h"    // what flaws leave of the others
#include "patches/regions.h"   // a large mesh in regions, each with its own patches

// ====================================================== surface: each patch described from outside
#include "surface/pieces.h"   // triangles cut by the cells of the centres
#include "surface/runs.h"     // points, segments and triangles, in runs of neighbours
#include "surface/balls.h"    // the least ball that holds all points
#include "surface/slabs.h"    // a direction in which the points are thin
#include "surface/hulls.h"    // 16 vertices about a patch
#include "surface/sorted.h"   // pieces by patch; eight extremes of each, for the network
#include "surface/surface.h"  // patch by patch: ball, slab, hull, triangles

// ====================================================== encoder: what the network keeps of a patch
#include "encoder/model.h"    // does weights.h fit?
#include "encoder/encoder.h"  // a patch -> its latent

// ================================================================================== body: the blob
#include "body/body.h"       // balls in groups of 16, and levels of spheres above
#include "body/traversal.h"  // a traversal of the groups; load, scale, describe
#include "body/geometry.h"   // the blob of the proof: slabs, hulls, triangles
#include "body/trust.h"      // is a blob sound? load it, scale it, describe it
#include "body/write.h"      // a surface -> the blob of the proof
#include "body/encode.h"     // nsvcd_encode
#include "body/shapes.h"     // spheres, capsules, boxes, clouds

#endif  // NSVCD__ISA

// ===================================================================== lanes: 16 numbers at a time
#include "lanes/lanes.h"  // AVX-512, AVX2, SSE2, NEON, SIMD128 or plain C
#include "lanes/turns.h"  // rotations, lane by lane

// ======================================================================== motion: where bodies are
#include "motion/motion.h"    // the moving body's poses as the fixed one sees them
#include "motion/segments.h"  // how far a point deviates from a straight line
#include "motion/choice.h"  // which segments a motion is cut into, and a long one which intervals

// ================================================================== search: which patches may meet
#include "search/apart.h"      // pairs of patches that a plane separates, by their extremes
#include "search/intervals.h"  // when the balls of two patches meet, for the network
#include "search/search.h"     // which groups and patches meet, and in which segments

// ==================================================================== proof: whether surfaces meet
#include "proof/proof.h"           // the theorem; what a proof asks, knows and remembers
#include "proof/poses.h"           // poses in double
#include "proof/motion_bounds.h"   // a interval of time, and how far points deviate in it
#include "proof/slabs.h"           // planes across slabs, of patches and of groups
#include "proof/hulls.h"           // planes between hulls
#include "proof/triangle_pairs.h"  // a triangle of each body, in double
#include "proof/blocks.h"          // 16 triangles at a time
#include "proof/manifold.h"        // contact points that hold a body
#include "proof/witnesses.h"       // two triangles that meet at one time
#include "proof/patch_pairs.h"  // two patches: separated by planes or by triangles, or in contact
#include "proof/containment.h"  // what is inside of what, exactly
#include "proof/loop.h"         // the loop: all that a search finds is resolved
#include "proof/verdict.h"      // what one search says: do they meet, when first, how near
#include "proof/long.h"         // the verdict, whatever the length of the motion
#include "proof/leave.h"        // leaving a contact, and how deep it is
#include "proof/normals.h"      // a contact's normal, against the motion

// ============================================================================= network: an opinion
#include "network/latent_rotation.h"  // Wigner matrices; latents turned by them
#include "network/winding_number.h"   // what is inside of what, for the network
#include "network/pairs.h"            // pairs of patches -> invariants
#include "network/decoder.h"          // invariants -> logits and distances, in float or int8

// =============================================================== query: a question, and its answer
#include "query/task.h"        // a question that has been checked, and its memory
#include "query/by_network.h"  // an answer by the network
#include "query/by_proof.h"    // an answer by proof
#include "query/question.h"    // check, who moves, lay out, answer, write
#include "query/self_test.h"   // a question by hand, whose answer is known

// ======================================================== gradient: of distance or logit, by poses
#include "gradient/by_pair.h"   // by the decoder's inputs, and by the pair
#include "gradient/gradient.h"  // by the poses, and by the times of contact

#ifndef NSVCD__ISA
// ==================================================================== entry: the processor decides
#include "entry/processor.h"  // SSE2, AVX2 or AVX-512; the public functions of queries

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
