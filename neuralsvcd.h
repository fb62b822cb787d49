// neuralsvcd.h - v0.3.0 - does this body, moving along this trajectory, hit that body?
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
//     question.ask = NSVCD_ASK_FIRST;
//     question.to = 0.001f;  // metres
//
//     nsvcd_answer answer;
//     const size_t size = nsvcd_sweep_workspace_size(&question);
//     if (nsvcd_sweep(&question, malloc(size), size, &answer)) return 1;
//     if (answer.verdict == NSVCD_HIT) printf("hits at t = %g\n", (double)answer.time.high);
//     return 0;
//   }
//
// Or plan a motion that hits nothing: nsvcd_plan, below.
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
//   NSVCD_NO_ROBOTS   no joints: nsvcd_check and its kin go
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
//   surfaces come as close as the triangles are stored (nsvcd_body_facts.quantum of both bodies;
//   with rounding, less than twice that), that of eight rays none could tell whether one is inside
//   the other, or that the work allowed was not enough; then the network's opinion is added where
//   it has one. A component of a mesh is closed if every edge has its reverse; what is open
//   encloses nothing.
//   By the network all is an opinion, whose measured error rates are in tests/bench/RESULTS.md. It
//   knows nothing finer than a few millimetres on bodies of 0.1 to 0.4 m: where bodies rest on one
//   another, ask for a proof. What is inside is an estimate, a winding number of patches: reliable
//   for closed meshes of one piece.
//
// NUMERIC ROBUSTNESS, as measured by `make race`, `make bench`, tests/test_proof.c and
// tests/bench/extremes.sh
//   A query reckons in float32, but with couples of triangles and with what is inside of what in
//   double.
//   Range         coordinates up to NSVCD_MAX_COORDINATE; bodies from NSVCD_MIN_RADIUS, below which
//                 squares underflow. Proofs are tested from 3e-11 to 3e5 m.
//   Quantum       a stored triangle is off by this: a few micrometres at most on bodies of 0.3 m.
//   Rounding      proofs allow for NSVCD__ROUNDING, two millionths, of the distances and extents
//                 involved: 2 um for bodies of 0.3 m, 80 um where one measures 20 m. So much room,
//                 and little more, must be between surfaces that are to be certified free.
//   Far away      positions are taken relative to the fixed body first: a scene 10 km from the
//                 origin loses what its own coordinates lose, about 1 mm. All is reckoned in the
//                 frame of one body, the one that rests or is the larger, in units of its scale.
//   Resolution    the network's limit: a patch must not be much larger than the clearance in
//                 question. With 512 patches each, a body of 5 cm against one of 0.3, 1, 3 and 20 m
//                 is judged right in 98.5, 93.5, 74 and 54 % of problems near contact; with the
//                 large mesh cut to what the motion can reach (nsvcd_mesh_cut), in 99 %. For the
//                 proof, the size of patches decides only what an answer costs.
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
//   Joints (nsvcd_check, nsvcd_plan) are placed by libm's sines.
//   With NSVCD_ONE_PATH blobs without latents and answers by proof are the same to the bit with
//   SSE2, AVX2, AVX-512, NEON, SIMD128 and plain C, so that two machines replay a game alike: the
//   same operations in the same order, no products fused into sums, sines and angles of this
//   header's own. gcc fuses where it is told neither -std=c99 or the like nor -ffp-contract=off,
//   clang with -ffp-contract=fast: then nsvcd_self_test says BUILD. It costs 4 to 14 %
//   (`make bench-one-path`).
//
// CONTENTS: a room's name ends a line of dashes. Each uses only those above it.
//   interface: what a program sees
//     options         what is compiled; the version
//     results         codes, what they say, the caller's allocator
//     meshes          OBJ files, parts of a mesh
//     bodies          encoding, loading, scaling, facts
//     queries         movers, options, answers; nsvcd_sweep and its kin
//     certificates    a mesh's tree; a proof as bytes; nsvcd_certify
//     robots          joints, parts, checks of motions; nsvcd_check
//     postures        one configuration: what is near, a way out; nsvcd_gaps
//     routes          a start and goals; nsvcd_route
//     plans           splines, planning problems; nsvcd_plan
//   ground: numbers and memory
//     compiler        what is asked of the compiler; libc and libm
//     strings         what codes and statuses say
//     angles          sines and angles, by libm or reckoned here
//     bits            bits and sizes
//     points          vectors of three, of floats and of doubles
//     rotations       quaternions and matrices, of floats and of doubles
//     spheres         spheres and discs, as bodies store them
//     random          random numbers
//     memory          the allocator; the rows of a workspace
//     slices          how many of 16 lanes a register holds
//   mesh: files and triangles
//     mesh            checks, cuts at a box
//     polygons        polygons into triangles
//     obj             Wavefront OBJ
//     stl             STL, binary and text
//   patches: a mesh in parts
//     samples         points of the surface, in equal share
//     clusters        farthest point sampling, then Lloyd's algorithm
//     covering        balls that cover the surface; patches as a whole
//     topology        welded vertices, components, which of them are closed
//     regions         a large mesh in regions, each with its own patches
//   surface: each patch described from outside
//     pieces          triangles cut by the cells of the centres
//     runs            points, segments and triangles, in runs of neighbours
//     balls           the least ball that holds all points
//     discs           a direction in which the points are thin
//     hulls           16 vertices about a patch
//     surface         patch by patch: ball, disc, hull, triangles
//   encoder: what the network keeps of a patch
//     model           does weights.h fit?
//     encoder         a patch -> its latent
//   body: the blob
//     body            balls in groups of 16, and levels of spheres above
//     walk            a walk through the groups; load, scale, describe
//     facets          the blob of the proof: discs, hulls, triangles
//     trust           is a blob sound? load it, scale it, describe it
//     encode          nsvcd_encode
//     shapes          spheres, capsules, boxes, clouds
//   lanes: 16 numbers at a time
//     lanes           AVX-512, AVX2, SSE2, NEON, SIMD128 or plain C
//     turns           rotations, lane by lane
//   motion: where bodies are
//     motion          the moving body's poses as the fixed one sees them
//     segments        how far a point strays from a straight line
//   search: which patches may meet
//     intervals       when the balls of two patches meet, for the network
//     search          which groups and patches meet, and in which segments
//   proof: whether surfaces meet
//     proof           the theorem; what a proof asks, knows and remembers
//     poses           poses in double
//     spans           a stretch of time, and how far points stray in it
//     discs           planes across discs, of patches and of groups
//     hulls           planes between hulls
//     couples         a triangle of each body, in double
//     blocks          16 triangles at a time
//     manifold        contact points that hold a body
//     witnesses       two triangles that meet at one time
//     items           an item: parted by planes, or by its triangles, or in contact
//     containment     what is inside of what, exactly
//     loop            the loop: all that a search finds is settled
//     verdict         the verdict, the first contact, the least distance
//     leave           leaving a contact, and how deep it is
//   network: an opinion
//     latent_rotation Wigner matrices; latents turned by them
//     winding_number  what is inside of what, for the network
//     pairs           pairs of patches -> invariants
//     decoder         invariants -> logits, in float or int8
//   query: a question, and its answer
//     task            a question that has been checked, and its memory
//     by_network      an answer by the network
//     by_proof        an answer by proof
//     question        check, who moves, lay out, answer, write
//     self_test       a question by hand, whose answer is known
//   gradient: of the logit by the poses
//     by_pair         by the decoder's inputs, and by the pair
//     gradient        by the poses, and by the times of contact
//   entry: the processor decides
//     processor       SSE2, AVX2 or AVX-512; the public functions of queries
//   certificate: a proof that others can check
//     tree            boxes over triangles, components
//     law             where a body is, how far points leave their chords
//     planes          one that parts two nodes for a while
//     rays            what a ray crosses
//     certify         the walk, and its bits
//   robot: is a motion of joints free?
//     chain           what moves what; where everything is
//     steps           what the joints do between two times
//     stray           by how much a part leaves the line and the slerp between two samples
//     path            pieces, pair by pair
//     trees           configurations, and the nearest of them
//     postures        one configuration: gaps and their slopes, a way out, who can meet
//     ramps           from one state to another, within limits of speed and acceleration
//     smooth          a way in time, then smooth
//     route           two trees of proven edges, shortcuts
//   plan: a motion that hits nothing
//     spline          quintic Hermite
//     problem         a planning problem in the caller's workspace
//     culling         which bodies may meet when; what a collision costs
//     cost            control points -> cost, and its derivative
//     explore         MPPI
//     refine          L-BFGS, with bundled gradients
//     plan            several seeds, and the last check
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
//   moving, fixed     the bodies of a query: all is reckoned in the frame of the fixed one, which
//                     is also said to rest
//   segment           a part of the motion, up to 20 degrees of turn; 64 at most. The planner has
//                     its own: see plan/problem
//   chord             of a point: the straight line from its start to its end in a segment
//   deviation         how far a point may stray from its chord: by bulge (rotation) and drift
//   candidate         two patches and a contact interval, in which their balls meet
//   pair              two patches, as the decoder sees them
//   ranker            the tiny decoder, which chooses the candidates that the chosen one sees
//   item              two patches that the proof has yet to part in a segment
//   couple            two listed triangles, one of each body
//   disc              of a patch: what it reaches along a normal, and across
//   hull, slack       of a patch: 16 vertices at most, and how far the surface sticks out
//   listing           a triangle, or a part of one, that a patch stores
//   facets            what a body stores for the proof: discs, hulls, listings
//   quantum           how far a stored triangle may be off the mesh's
//   span              a segment, or a part of one, as the proof bounds its motion
//   knot, arc         when one of the poses given is reached; the motion from a knot to the next
//   tick              the unit of a motion's time: every knot is at a whole number of ticks
//   work              units that a proof takes
//   part, link, piece a body of a scene; what a joint carries; of a motion of joints, one curve
//   step, sample      of a piece, between two samples; a configuration in which parts are placed
//   stray             by how much a part leaves, in a step, the line and the slerp between samples
//   lever             how far a point of a part can be from a joint's axis
#ifndef NEURALSVCD_H
#define NEURALSVCD_H

// ================================================================== interface: what a program sees

// ------------------------------------------------------------------------------- interface/options
// In: what is defined before the header. Out: what follows from it, and how functions are declared.

// as the first line says; before 1.0 a minor version may change what a program sees
#define NSVCD_VERSION "0.3.0"
#define NSVCD_VERSION_MAJOR 0
#define NSVCD_VERSION_MINOR 3
#define NSVCD_VERSION_PATCH 0

#if defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_OBJ)
#define NSVCD_NO_OBJ
#endif
#if defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_CERTIFICATES)
#define NSVCD_NO_CERTIFICATES
#endif
#if defined(NSVCD_NO_PROOF) && defined(NSVCD_NO_NETWORK)
#error "neuralsvcd.h: NSVCD_NO_PROOF and NSVCD_NO_NETWORK leave nothing that answers"
#endif
#if defined(NSVCD_NO_NETWORK) && !defined(NSVCD_NO_GRADIENT)
#define NSVCD_NO_GRADIENT
#endif
#if defined(NSVCD_NO_GRADIENT) && !defined(NSVCD_NO_OPTIMIZER)
#define NSVCD_NO_OPTIMIZER
#endif
#if defined(NSVCD_NO_INT8) && defined(NSVCD_NO_FLOAT)
#error "neuralsvcd.h: NSVCD_NO_INT8 and NSVCD_NO_FLOAT leave no decoder"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ && \
    defined(NEURALSVCD_IMPLEMENTATION) && defined(__GNUC__)
#pragma GCC warning \
    "neuralsvcd.h: -ffinite-math-only: bad input is still refused, but results are not tested so"
#endif

#include <stddef.h>
#include <stdint.h>

#if defined(NSVCD_STATIC) && (defined(__GNUC__) || defined(__clang__))
#define NSVCDDEF static __attribute__((unused))  // nobody calls all of them
#elif defined(NSVCD_STATIC)
#define NSVCDDEF static
#else
#define NSVCDDEF extern
#endif
#ifdef __cplusplus
extern "C" {
#endif

// ------------------------------------------------------------------------------- interface/results
// In: nothing. Out: codes of what may fail, what they say, and the caller's allocator.

typedef enum nsvcd_result {
  NSVCD_OK = 0,
  // NULL where it is not allowed, or an option out of its range
  NSVCD_ERROR_ARGUMENT,
  // the file is missing or cannot be read
  NSVCD_ERROR_IO,
  // the allocator returned NULL
  NSVCD_ERROR_MEMORY,
  // OBJ: a line that cannot be understood, or a face of one or two vertices
  NSVCD_ERROR_SYNTAX,
  // an index that is zero, or refers to no vertex
  NSVCD_ERROR_INDEX,
  // a coordinate is not finite, or larger than NSVCD_MAX_COORDINATE
  NSVCD_ERROR_NUMBER,
  // no triangle, no area, or all of it within NSVCD_MIN_RADIUS
  NSVCD_ERROR_EMPTY,
  // more vertices, triangles or bytes than can be counted
  NSVCD_ERROR_TOO_LARGE,
  // a pose is not finite, or its quaternion is not of unit length to 1e-4
  NSVCD_ERROR_POSE,
  // a scale is not finite, negative or out of range, or the body becomes larger or smaller than
  // a body may be
  NSVCD_ERROR_SCALE,
  // a tolerance, a clearance or the like is negative, not finite, or beyond the scene
  NSVCD_ERROR_TOLERANCE,
  // both sides of a question are the same body in the same motion: something was passed twice
  NSVCD_ERROR_SAME,
  // a blob is damaged, cut short, misaligned, or of another version, model or byte order; or a body
  // lacks what the method needs
  NSVCD_ERROR_BODY,
  // the memory given is too small, or not aligned to NSVCD_ALIGNMENT bytes
  NSVCD_ERROR_WORKSPACE,
  // by the caller's progress function
  NSVCD_ERROR_CANCELLED,
  // the compiler, or its flags, made a program that reckons wrongly
  NSVCD_ERROR_BUILD
} nsvcd_result;

// What a result says, for a person: a sentence without a full stop, never NULL.
NSVCDDEF const char *nsvcd_result_string(nsvcd_result result);

// Does this build reckon rightly, on this processor? Certificates of one that does not are false.
// To be called once, at the start, where the compiler is not gcc, clang or MSVC, or where its flags
// are unusual. It looks at how structs and floats are passed, at vectors, rotations, the test that
// certificates rest on, and two triangles. What it does not look at may be wrong still.
//   allocates  nothing, and takes a microsecond (tests/test_processor.c)
//   errors     BUILD
NSVCDDEF nsvcd_result nsvcd_self_test(void);

// Where memory comes from. NULL in place of an allocator means malloc and free.
//   alloc      returns memory aligned as malloc's, or NULL on failure
//   user       handed to both
typedef struct nsvcd_allocator {
  void *(*alloc)(size_t size, void *user);
  void (*free)(void *memory, void *user);
  void *user;
} nsvcd_allocator;

// -------------------------------------------------------------------------------- interface/meshes
// In: an OBJ or STL file, or triangles of the caller. Out: nsvcd_mesh, or a part of one.

typedef struct nsvcd_mesh {
  // (vertex_count, 3) metres
  float *positions;
  // (triangle_count, 3) vertices, counter-clockwise from outside
  uint32_t *indices;
  size_t vertex_count;
  size_t triangle_count;
} nsvcd_mesh;

#ifndef NSVCD_NO_OBJ
// Reads OBJ text into a mesh. Only lines v and f matter; they end in LF, CR or CR LF. Corners of a
// face are v, v/vt, v//vn or v/vt/vn, and may refer to vertices further down. Faces of any number
// of corners are cut into triangles, concave ones too.
//   text       (size) characters, not NULL; they need not end in a NUL or a newline
//   allocator  NULL: malloc and free
//   mesh       not NULL; nsvcd_mesh_free gives it back; left as it was on failure
//   error_line NULL, or set to the line at fault, from 1; 0 where no line is at fault
//   allocates  the mesh, and working memory that is given back; time is linear in size, but for
//              concave faces of thousands of corners: of n corners, n^1.5 in the worst shapes that
//              tests/test_mesh.c tries
//   errors     ARGUMENT, MEMORY, SYNTAX, INDEX, NUMBER, EMPTY, TOO_LARGE. Of several faults the
//              one that is found first: statements and counts come before vertices, these before
//              faces
//   source     Wavefront, "Object Files", version 3.0; ear clipping after Meisters 1975
NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// nsvcd_obj_parse on what a file holds.
//   path       not NULL, as fopen takes it
//   errors     those of nsvcd_obj_parse, and IO
NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

// Reads STL, binary or text, into a mesh. Corners at the same place become one vertex; normals and
// attributes are skipped.
//   data       (size) bytes, not NULL
//   allocator, mesh, error_line  as above; of what is binary no line is at fault
//   allocates  the mesh, with room for three vertices a triangle, and working memory
//   errors     ARGUMENT, MEMORY, SYNTAX, NUMBER, EMPTY, TOO_LARGE
//   source     3D Systems, "StereoLithography Interface Specification", 1989
NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// nsvcd_stl_parse on what a file holds.
NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif
#endif
#ifndef NSVCD_NO_ENCODER
// Cuts out the part of a mesh within a box: triangles are cut at the box, vertices are not shared.
// For a large mesh that changes all the time, or that the network is to judge, whose patches must
// not be much larger than the gap in question: encode what the moving body can reach, the box over
// its sweep grown a little, as an `open` body. A mesh that stays is better encoded whole, once.
//   mesh       not NULL
//   low, high  the box in the mesh's frame, metres, not NULL, finite, low < high on each axis
//   allocator  NULL: malloc and free
//   part       not NULL; nsvcd_mesh_free gives it back; left as it was on failure
//   allocates  the part
//   errors     ARGUMENT, EMPTY (nothing of it is in the box), INDEX, NUMBER, TOO_LARGE, MEMORY
//   source     Sutherland and Hodgman 1974
NSVCDDEF nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *mesh, const float low[3],
                                     const float high[3], const nsvcd_allocator *allocator,
                                     nsvcd_mesh *part);
// Gives back what nsvcd_obj_parse, nsvcd_stl_parse, their files or nsvcd_mesh_cut allocated, and
// empties *mesh.
//   mesh       may be NULL
//   allocator  the one that it came from
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *allocator);
#endif

// -------------------------------------------------------------------------------- interface/bodies
// In: a mesh, or bytes that were a body. Out: nsvcd_body, and facts about it.

// An encoded body: one relocatable blob without pointers, aligned to NSVCD_ALIGNMENT. Copy it with
// memcpy, write it with fwrite, map it, or bake it into flash as a const array. IEEE 754, in the
// byte order of the machine that encoded it, and refused by one of the other order: it begins with
// "NSVB" where that is little-endian, with "BVSN" where it is big-endian. nsvcd_body_facts.size is
// its size. Threads may share it.
typedef struct nsvcd_body nsvcd_body;

#define NSVCD_ALIGNMENT 8
// Patches of a body, where the options do not say: of one with triangles, and of one for the
// network alone, which needs finer patches than a proof.
#define NSVCD_DEFAULT_PATCHES 192
#define NSVCD_DEFAULT_NETWORK_PATCHES 256
#define NSVCD_MAX_PATCHES 65536
// A body of more patches is a level: its patches are in a tree.
#define NSVCD_SMALL_PATCHES 512
// Where the options do not say, a mesh of up to VERY_FEW triangles has a patch for each, but no
// fewer than LEAST; of up to FEW, NSVCD_DEFAULT_PATCHES; of up to MANY, NSVCD_SMALL_PATCHES. A mesh
// of more is a level, with a patch for each 12 triangles. What is stored of a patch is as exact as
// it is small: of what is large and has few triangles, ask for more.
#define NSVCD_LEAST_PATCHES 12
#define NSVCD_VERY_FEW_TRIANGLES 48
#define NSVCD_FEW_TRIANGLES 32768
#define NSVCD_MANY_TRIANGLES 131072
#define NSVCD_LEVEL_TRIANGLES 12
// metres
#define NSVCD_MAX_COORDINATE 1e6f
// metres, of the sphere about a body
#define NSVCD_MIN_RADIUS 1e-12f
// per motion
#define NSVCD_MAX_POSES 65536
// of a body in a question
#define NSVCD_MIN_SCALE 1e-6f
#define NSVCD_MAX_SCALE 1e6f

// Told now and then how much is done, in [0,1]. Returns 0 to go on; otherwise the work is given up,
// and the result is NSVCD_ERROR_CANCELLED.
typedef int nsvcd_progress(float done, void *user);

// What is zero is the default.
typedef struct nsvcd_encode_options {
  // N, 1..NSVCD_MAX_PATCHES; 0: by the number of triangles, see above
  size_t patches;
  // metres; if > 0 and patches is 0: as many patches as have about this radius. For a level about
  // half the size of the bodies that move in it
  float patch_radius;
  // metres: the body is all that is no farther from the mesh than this. If > 0, triangles need no
  // area: one of the same vertex thrice is a ball, one of two vertices a capsule. Such a body has
  // no latents
  float round;
  // 1: the mesh is not closed (a sheet, or a part cut out): nothing counts as inside it
  int open;
  // 1: for the network too, of which the proof needs nothing: 40 bytes more a patch, and time
  int latents;
  // 1: for the network alone, in fewer bytes; then there is no proof
  int no_triangles;
  // NULL, or told how much is done
  nsvcd_progress *progress;
  // handed to progress
  void *user;
} nsvcd_encode_options;

#ifndef NSVCD_NO_NETWORK
// Bytes of a body without triangles; 0 if there can be no such body. One with triangles is larger:
// let nsvcd_encode allocate it.
NSVCDDEF size_t nsvcd_body_size(size_t patches);
// The same as a constant, for 1 to NSVCD_SMALL_PATCHES patches.
#define NSVCD_BODY_BYTES(patches) \
  ((64 + 28 * (((patches) + 15) / 16 * 16) + 16 * ((((patches) + 15) / 16 + 15) / 16 * 16) + \
    40 * (patches) + 7) / \
   8 * 8)
#endif

#ifndef NSVCD_NO_ENCODER
// Encodes a mesh into a body. The body may have fewer patches than asked, where the surface has too
// few points to tell apart. Same mesh, same bytes, in one build: see DETERMINISM above.
//   mesh       not NULL; not kept
//   options    NULL: the defaults, for the proof
//   allocator  NULL: malloc and free
//   memory     (capacity) bytes, aligned to NSVCD_ALIGNMENT, for the body. NULL: the body comes
//              from the allocator, and nsvcd_body_free gives it back
//   body       not NULL; set to the body; left as it was on failure
//   allocates  working memory, which is given back, and the body where memory is NULL
//   errors     ARGUMENT, INDEX, NUMBER, EMPTY, TOO_LARGE, MEMORY, WORKSPACE, CANCELLED
//   source     the latents: NeuralSVCD, appendix F; the triangles: this library
NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *allocator, void *memory,
                                   size_t capacity, const nsvcd_body **body);
#ifndef NSVCD_NO_PROOF
// Bodies of a shape, for the proof, exact but for the roundings of float: what nsvcd_encode makes
// of a point, a segment, a box or points and options.round. Where time matters they are better than
// meshes of many triangles: a capsule is one segment. Voxels are a cloud of their centres: with a
// radius of 0.8661 edges it contains the cubes, with half an edge it is within them; exact are only
// their faces, as a mesh. A map that changes is best kept in chunks of some 16 x 16 x 16 cells, a
// body each, of which only those with changes are encoded anew; nsvcd_sweep_batch asks all that are
// near.
//   radius, round   metres, > 0; that of a box may be 0
//   from, to        the ends of the capsule's axis, not NULL, metres; may be the same
//   half            half of what the box measures, round edges and all, not NULL, metres; none is
//                   less than round
//   points          (count, 3) metres, not NULL, not kept
//   allocator       NULL: malloc and free
//   body            not NULL; set to the body, about the origin or where its ends and points are;
//                   left as it was on failure; nsvcd_body_free gives it back
//   allocates       the body, and working memory, which is given back
//   errors          ARGUMENT, NUMBER, EMPTY, TOO_LARGE, MEMORY
NSVCDDEF nsvcd_result nsvcd_encode_sphere(float radius, const nsvcd_allocator *allocator,
                                          const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_capsule(const float from[3], const float to[3],
                                           float radius, const nsvcd_allocator *allocator,
                                           const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_box(const float half[3], float round,
                                       const nsvcd_allocator *allocator,
                                       const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_cloud(const float *points, size_t count, float radius,
                                         const nsvcd_allocator *allocator,
                                         const nsvcd_body **body);
#endif
// Gives back a body that nsvcd_encode allocated.
//   body       may be NULL
//   allocator  the one that it came from
NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *allocator);
#endif

// Checks a blob that nobody vouches for, every byte of it, and takes it for a body.
//   memory     (size) bytes, not NULL, aligned to NSVCD_ALIGNMENT; the body stays in it
//   body       not NULL; set to the body; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (NULL), BODY (anything is wrong with it)
NSVCDDEF nsvcd_result nsvcd_body_load(const void *memory, size_t size,
                                      const nsvcd_body **body);

// nsvcd_body_load for bytes that are known to be what nsvcd_encode made. Only the header is read:
// is it a body of this version and these weights, and is all of it there? For an array baked into
// the program, and for a large mapped file that was loaded once before: its pages are then read as
// queries need them. Bytes that were changed since do harm: wrong answers, or reads anywhere.
// Arguments and errors are those of nsvcd_body_load.
NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body);

// Writes a copy of a body, scaled about its origin: for a planner's bodies, or to bake one; a
// question has scales of its own. Latents do not depend on scale, and answers scale along, to
// rounding.
//   body       not NULL
//   scale      > 0
//   memory     (capacity) bytes, not NULL, aligned to NSVCD_ALIGNMENT; may be where the body is
//   scaled     not NULL; set to the copy; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (also if the copy were smaller or larger than a body may be), WORKSPACE;
//              with NSVCD_NO_PROOF also BODY: it has triangles, which that cannot scale
NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, float scale, void *memory,
                                       size_t capacity, const nsvcd_body **scaled);

typedef struct nsvcd_body_facts {
  // bytes: what to save
  size_t size;
  // N
  size_t patches;
  // metres: a sphere that contains the body
  float centre[3];
  float radius;
  // metres
  float mean_patch_radius;
  // of the mesh; 0: none are stored
  size_t triangles;
  // triangles and parts of them that are stored, patch by patch
  size_t listings;
  // metres: stored triangles are within this of the mesh's
  float quantum;
  // metres that the body goes beyond its mesh
  float round;
  // 1: the network can answer
  int latents;
} nsvcd_body_facts;

// What a body is.
//   body       not NULL
NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body);

// The sphere of one patch. Returns 1, or, if there is no such patch or no body, 0: then nothing is
// written.
//   patch      as in nsvcd_answer
//   centre     not NULL, metres, body frame
//   radius     not NULL, metres
NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius);

// ------------------------------------------------------------------------------- interface/queries
// In: two movers and options. Out: an answer, and its derivative.

// Takes a point x of the body's frame to the world: rotation x + position.
typedef struct nsvcd_pose {
  float position[3];  // metres
  // unit quaternion x y z w
  float rotation[4];
} nsvcd_pose;

// What is asked of two bodies that move.
typedef enum nsvcd_ask {
  // do they hit each other? Of the time, only that of some contact is told
  NSVCD_ASK_HIT = 0,
  // and when first?
  NSVCD_ASK_FIRST,
  // do they, and how near do they come?
  NSVCD_ASK_DISTANCE
} nsvcd_ask;

// How a question is answered.
typedef enum nsvcd_method {
  // by proof where both bodies have triangles, else by the network
  NSVCD_METHOD_DEFAULT = 0,
  NSVCD_METHOD_PROOF,   // facts
  NSVCD_METHOD_NETWORK  // an opinion, in a time that is bounded strictly
} nsvcd_method;

// The decoders, all on the same latents: about 4, 13 and 40 thousand multiplications for each pair
// of patches.
typedef enum nsvcd_model {
  // the largest that is compiled in
  NSVCD_MODEL_DEFAULT = 0,
  NSVCD_MODEL_TINY,
  NSVCD_MODEL_SMALL,
  NSVCD_MODEL_BASE
} nsvcd_model;

// The arithmetic of the decoder. Latents are int8 in any case.
typedef enum nsvcd_precision {
  NSVCD_PRECISION_FLOAT = 0,
  NSVCD_PRECISION_INT8
} nsvcd_precision;

// What the network is told. What is zero is the default.
typedef struct nsvcd_network_options {
  // K, pairs of patches that it looks at, 1..NSVCD_MAX_PAIRS; 0: NSVCD_DEFAULT_PAIRS
  size_t pairs;
  nsvcd_model model;
  nsvcd_precision precision;
  // share of collisions that it is to find: 0 (balanced errors), 0.99f, 0.999f or 0.9999f
  float recall;
} nsvcd_network_options;

#define NSVCD_DEFAULT_WORK 100000
#define NSVCD_NO_TRIANGLE 0xffffffffu
// that an answer names at most
#define NSVCD_MAX_CONTACTS 4
#define NSVCD_DEFAULT_PAIRS 8
#define NSVCD_MAX_PAIRS 256
// the logit of what a proof says is a hit; its negative is that of what is free
#define NSVCD_LOGIT_CERTAIN 100.0f
// of the radius of the smaller body's sphere: what `to` is where nothing is said
#define NSVCD_DEFAULT_TO 0.001f

// A body in a scene: how it moves, and how large it is. Many may share one body.
typedef struct nsvcd_mover {
  // from nsvcd_encode, nsvcd_body_load, nsvcd_body_trust or nsvcd_body_scale
  const nsvcd_body *body;
  // (count) poses; in between, position linear and rotation slerp. One: it rests there. NULL, and
  // count 0: it rests at the origin
  const nsvcd_pose *poses;
  // up to NSVCD_MAX_POSES
  size_t count;
  // (count) when it is at each, from 0 to 1, each later than the one before by 1e-7 or more;
  // rounded to 2^-32. NULL: uniform
  const float *times;
  // of the body, about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; 0: 1
  float scale;
} nsvcd_mover;

// Do two bodies hit each other? What is zero is the default, but for the bodies.
typedef struct nsvcd_question {
  // either may move, or both, in the same time; their counts of poses may differ
  nsvcd_mover a, b;
  nsvcd_ask ask;
  // metres. FIRST: no point of one body moves farther than this, as the other sees it, from the
  // time that is proven free to that of the contact; nor than a quarter of its way, if triangles
  // are stored as exactly as that. DISTANCE: how wide the bracket may be. 0 (and
  // to_time 0): NSVCD_DEFAULT_TO of the smaller body. Not with HIT
  float to;
  // FIRST: the same as a share of the motion, up to 1. Where both are set, both hold
  float to_time;
  // metres: to come as near as this is a hit; 0: to meet is one
  float clearance;
  // metres: a contact at the start that is no deeper than this does not count, nor does what is
  // nearer than the clearance by no more than this; what is both is to be so in sum. So a body may
  // rest on another, slide along it or leave it. The question is asked as if a were lifted off b,
  // by this much along the normals of all that it touches, and touches nothing then: see
  // answer.lift
  float skin;
  // metres: surfaces that come closer than this, or than this and the clearance, and do not meet,
  // may be left undecided
  float tolerance;
  // FIRST: 1: up to four contacts, which hold the body, are told, where else one is
  int manifold;
  nsvcd_method method;
  // units that a proof may take, about; 0: NSVCD_DEFAULT_WORK. A unit is a plane sought for two
  // patches, 16 triangles against the box of 16, one of them against these, two triangles at one
  // time, or a ray against 16 or one. An eighth is left once surfaces have come too near to tell;
  // of FIRST an eighth is kept for whether they meet at all
  size_t work;
  // a motion is cut into at most so many, a multiple of 16 up to 64; 0: 64. Fewer take less memory;
  // what turns by more than 20 degrees in one of them takes longer to prove
  size_t segments;
  // where it is the network that answers; it knows neither FIRST nor DISTANCE, nor a clearance or a
  // skin
  nsvcd_network_options network;
} nsvcd_question;

typedef enum nsvcd_verdict {
  NSVCD_UNDECIDED = 0,
  // the surfaces never come within the clearance; and nothing is inside of anything
  NSVCD_FREE,
  // they do, or one body, or a part of it, is inside of the other
  NSVCD_HIT
} nsvcd_verdict;

// A verdict in a word; never NULL.
NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict);

// Who says so.
typedef enum nsvcd_by {
  // it is a fact. Bodies without triangles may be FREE by it too: spheres that cover their surfaces
  // never meet, and only that nothing is inside is an estimate
  NSVCD_BY_PROOF = 0,
  // it is an opinion
  NSVCD_BY_NETWORK
} nsvcd_by;

// Why not all that was asked is answered.
typedef enum nsvcd_why {
  // all of it is
  NSVCD_WHY_NOTHING = 0,
  // surfaces come nearer than the quanta of both bodies and the tolerance, and do not meet; or, of
  // eight rays, none could tell whether one is inside the other
  NSVCD_WHY_TOO_NEAR,
  // question.work was not enough
  NSVCD_WHY_WORK
} nsvcd_why;

// What is known of a number: it is no less than `low`, and no more than `high`.
typedef struct nsvcd_range {
  float low, high;
} nsvcd_range;

// Two triangles, and where they meet or are nearest.
typedef struct nsvcd_contact {
  // metres, world. Where they meet, or on b where they are nearest: on its surface, if it is round.
  // Of a large triangle, which is stored in parts, on the part that was looked at last
  float point[3];
  // world. Unit normal of one of them, from b to a (an open surface met from behind: as it is
  // wound), or, where they are apart, the direction from b's to a's. 0 where none are named, and
  // where that triangle has no area
  float normal[3];
  // metres between the stored triangles, less what is round; 0: they meet
  float gap;
  // in [0,1]: when
  float time;
  // as numbered in the caller's meshes; NSVCD_NO_TRIANGLE where none are named
  uint32_t triangle_a, triangle_b;
  // that list them
  uint32_t patch_a, patch_b;
  // of a manifold: of the corner, or the two edges, that touch; the same as long as they do
  uint32_t id;
} nsvcd_contact;

// Where the bodies may go: to where they are at a time until which they are free of each other,
// lifted off what they touch.
typedef struct nsvcd_safe_place {
  // time.low, or, where they are about to touch then, a hair before
  float time;
  // of both, world. The lift is in the pose of a; where only b moves, in that of b
  nsvcd_pose a, b;
} nsvcd_safe_place;

// What the network thinks.
typedef struct nsvcd_opinion {
  // 1: it was asked. Otherwise all is 0
  int asked;
  // of collision, positive is yes: the greatest of the pairs looked at, less the threshold that
  // `recall` asks for; the search ends at the first above 3. Where the tiny decoder, which ranks
  // the pairs, is clear (beyond +-3), that one answers. NSVCD_LOGIT_CERTAIN, or its negative: no
  // decoder was needed
  float logit;
  // in [0,1]: when the most suspicious pair comes closest
  float time;
  // that pair
  uint32_t patch_a, patch_b;
  // pairs of patches whose spheres meet, each counted once for each stretch of time, until the
  // search ends
  size_t candidates;
  // 1: there were more of these than `pairs` let through
  int limited;
} nsvcd_opinion;

// One meaning a field, whatever was asked and whoever answers. What is not known is HUGE_VALF, or a
// count of 0.
typedef struct nsvcd_answer {
  nsvcd_verdict verdict;
  nsvcd_by by;
  nsvcd_why why;
  // 1: a hit, for one body or a part of it lies inside the other at the start, by proof or by the
  // network's estimate. Surfaces may meet as well: a plain question does not look for that
  int inside;
  // in [0,1]. They are free of each other before `low`, and in contact at `high`. FREE: 1, 1. Low
  // is 0 where not asked for FIRST
  nsvcd_range time;
  // metres: the least distance over the motion, up to time.high where that is known: to the
  // clearance or less that they come, if they hit. What stored triangles are off by is allowed for,
  // and so `high` is not 0 where they meet
  nsvcd_range distance;
  nsvcd_safe_place safe;
  // metres: of a contact at the start, the smallest lift of a off b, up to the skin or where it is
  // made of several normals their sum, that ends it. 0: there is no contact at the start
  float depth;
  // metres, world, at the start: by what a was lifted off b for the skin; it turns with b, or,
  // where a rests, or both move and a is the larger, with a. The answer is about the motion so
  // displaced, which touches nothing at the start. 0: nothing was touched; or no lift does that,
  // since a is pressed in deeper than the skin, or held from all sides: then the contact counts
  float lift[3];
  // of a HIT whose triangles are known, at time.high: one, or a manifold, in the order of its ids.
  // That is of all places that are no farther apart than `to` (or the default, where only to_time
  // is given) and the clearance the four that span most
  size_t contact_count;
  nsvcd_contact contacts[NSVCD_MAX_CONTACTS];
  // the triangles that distance.high is about, whatever the verdict: of a HIT the contact that
  // was found; of what is UNDECIDED two that come too near to tell, of FIRST the earliest. None are
  // named where none were found. Of what is inside the point alone is set, one of it
  nsvcd_contact nearest;
  nsvcd_opinion opinion;
  // units that the proof took
  size_t work;
} nsvcd_answer;

// Bytes of the workspace that nsvcd_sweep needs; 0 if the question is refused. They depend on the
// sizes of the bodies, the method, the segments, and the network's pairs and model.
//   question   NULL: enough for any question
NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question);

// Answers a question. The same question, the same answer, in one build: see DETERMINISM above; and
// the same verdict whichever body is a and which b.
//   question   not NULL
//   workspace  (workspace_size) bytes, nsvcd_sweep_workspace_size(question) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each with its own workspace; they may share bodies
//   errors     ARGUMENT, POSE, SCALE, TOLERANCE, SAME, WORKSPACE, and BODY where a body lacks what
//              the method needs
//   source     the proof: this library, proof/proof; the network: NeuralSVCD, algorithm 1
//
// What a proof says is about the surfaces of the two meshes, scaled and posed exactly as described.
// FREE, and a HIT of what is inside, hold for the meshes themselves. The triangles of any other HIT
// meet to within the two bodies' quanta (nsvcd_body_facts, times the scale). UNDECIDED are surfaces
// that come as close as that without meeting, or more work than was allowed. More work never leaves
// undecided what less decides, but for luck: FIRST with a few hundred units.
//
// What it costs: Ga and Gb are the bodies' groups of 16 patches. A motion has S segments: 16 or so
// up to 320 degrees of turn, 64 at most. The search takes at most 18 S Ga Gb + 3 S tests of 16
// spheres against one; by the network, for motions that turn by more than 45 degrees, on machines
// of less than 16 lanes, 34 S Ga Gb. Of bodies of more than 512 patches only those groups count
// that the other body comes near, and some 16 tests more for each level of spheres and each 16
// spheres of it that it comes near. Then a proof takes question.work units. The network takes the
// tiny decoder on 12 K pairs and the chosen one on K (tiny alone: on 3 K), and 32 distances for
// each patch.
NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer);

// Workspaces as constants, for arrays of a fixed size, a little larger than need be. Where one
// workspace is for both methods, take the larger.
//   patches_a, patches_b patches of the bodies, or more
//   segments             question.segments, 16 to 64
//   pairs                question.network.pairs, K
// NSVCD_MEMORY declares an array that is aligned:
//   static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(64, 192, 16));
#define NSVCD_MEMORY(name, bytes) uint64_t name[((bytes) + 7) / 8]
#define NSVCD__GROUPS_OF(patches) ((patches) > 512 ? 32 : ((patches) + 15) / 16)
#define NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) \
  (1024 + 704 * (segments) + 8 * NSVCD__GROUPS_OF(patches_a) * NSVCD__GROUPS_OF(patches_b) + \
   ((patches_a) > 512 || (patches_b) > 512 ? 1024 : 0))
#define NSVCD_PROOF_WORKSPACE_BYTES(patches_a, patches_b, segments) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 24576 + 168 * (segments))
#define NSVCD_NETWORK_WORKSPACE_BYTES(patches_a, patches_b, segments, pairs) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 96 * (pairs))

// Answers many questions, as a frame of a game or a sampling planner has them. Where a question and
// the one before it ask the network about the same two bodies, it is first asked where that one
// collided. If that is a clear collision again (logit above 3), it is the answer, and the rest is
// not searched. All other answers are nsvcd_sweep's, to the bit.
//   questions  (count); count may be 0
//   workspace  as for nsvcd_sweep, large enough for each of them
//   answers    (count); left as they were on failure
//   allocates  nothing
//   threads    as nsvcd_sweep
//   errors     those of nsvcd_sweep, of the first question that has one
//   source     this library; physics engines call it temporal coherence
NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers);

#ifndef NSVCD_NO_GRADIENT
// Answers a question by the network, with the derivatives of its logit by the poses of a and b.
// What drives the poses (joints, a spline) goes on from there by the chain rule.
//   question   its method is not PROOF, and nothing is asked that only a proof knows
//   workspace, answer   as for nsvcd_sweep
//   gradient_a, gradient_b   (count, 6), one row for a body without poses; one of them may be NULL;
//              left as they were on failure. Of each pose: by a displacement of the body's origin
//              (metres, world axes), then by a small rotation about that origin (rotation vector,
//              radians, world axes, applied on the left)
//   allocates  nothing
//   threads    as nsvcd_sweep
//   errors     those of nsvcd_sweep
//   source     reverse mode; this library
//
// Zero where no decoder was needed, and for poses that the decisive pair does not pass. It is
// the gradient of the pair and the stretch of time that decided: the logit is the greatest of
// several, and so has kinks, also where the network (ReLU) and the frame of a pair have theirs.
// Where the pair is at rest, or does not turn, it is the mean of both sides. The ends of the
// stretch move with the poses, but for those at t = 0 or 1 and where a segment of the search
// begins or ends. The unit of length, and the spheres' allowance for what the motion does
// between its knots, are taken as constant. In int8 arithmetic it is the derivative of the float
// decoder, or, without that, of the function that the int8 one rounds.
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b);
#endif

// -------------------------------------------------------------------------- interface/certificates
// In: a question, and its two meshes. Out: bytes that prove the answer to whoever has the meshes
// and examples/verify, which shares nothing with this library.

#ifndef NSVCD_NO_CERTIFICATES
// A tree of boxes over the triangles of a mesh, in the caller's memory, for nsvcd_certify. It keeps
// pointers to the mesh's arrays, which stay as they are; threads may share it.
typedef struct nsvcd_tree nsvcd_tree;

// Bytes of the memory that nsvcd_tree_build needs; 0 if there can be no such mesh. About 56 for a
// triangle and 4 for a vertex.
NSVCDDEF size_t nsvcd_tree_size(const nsvcd_mesh *mesh);

// Builds the tree of a mesh: once for each mesh, in a time like that of sorting it.
//   mesh       not NULL
//   memory     (size) bytes, nsvcd_tree_size(mesh) or more, not NULL, aligned to NSVCD_ALIGNMENT
//   tree       not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, INDEX, NUMBER, EMPTY, TOO_LARGE, WORKSPACE
NSVCDDEF nsvcd_result nsvcd_tree_build(const nsvcd_mesh *mesh, void *memory, size_t size,
                                       const nsvcd_tree **tree);

#define NSVCD_DEFAULT_VISITS 1000000

// What is zero is the default.
typedef struct nsvcd_certify_options {
  // NULL, or what nsvcd_sweep answered: where a hit is looked for first. Nothing is believed of it
  const nsvcd_answer *answer;
  // that may be taken, steps of the walk that a certificate is; 0: NSVCD_DEFAULT_VISITS
  size_t visits;
} nsvcd_certify_options;

typedef struct nsvcd_certificate {
  // FREE or HIT: the bytes prove it. UNDECIDED: there are none
  nsvcd_verdict verdict;
  // 1: a hit, for a corner of one is inside of the other
  int inside;
  // of a HIT, in [0,1]
  double time;
  // of all of it, also where that is more than there was room for
  size_t size;
  // that were taken
  size_t visits;
} nsvcd_certificate;

// Bytes of the workspace that nsvcd_certify needs: some 250 for each pose of either, and 4 for each
// vertex of the mesh that has more.
NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b);

// Proves the answer to a question anew, sharing nothing with nsvcd_sweep but what a pose is, and
// writes the proof. FREE: the two surfaces never come within the clearance and nothing is inside of
// anything. HIT: an edge passes through a triangle, or points are nearer than the clearance, or a
// corner is inside, at a time that is told. What only touches, or is nearer than 1e-10 of all
// lengths, stays UNDECIDED.
//   question   not NULL; of it the poses, times and scales, and the clearance. Bodies are not looked
//              at and may be NULL
//   a, b       trees of the meshes of question->a and question->b, not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_certify_workspace_size or more, not NULL, aligned to
//              NSVCD_ALIGNMENT
//   bytes      (capacity): the certificate, as far as there is room; NULL where capacity is 0. Free
//              motions take 40 to 300 bytes in the median, 2,000 in the mean and 90,000 at most
//   made       not NULL
//   allocates  nothing
//   errors     ARGUMENT (also if there is a skin), SCALE, POSE (also a turn by 180 degrees, which
//              could go either way), TOLERANCE, WORKSPACE
//   source     this library; the walk is described in examples/verify/nsvcd_verify.h. Planes by
//              Gilbert 1966
NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made);
#endif  // NSVCD_NO_CERTIFICATES

// -------------------------------------------------------------------------------- interface/robots
// In: a robot among obstacles, and a motion of its joints. Out: is it free, as the joints make it?
//
// Between two samples of a joint motion a link leaves the line and the slerp that nsvcd_sweep is
// about. By how much, at most, follows from the joints (robot/stray): with that as clearance the
// sweep proves the joints' own motion, at all times.

#define NSVCD_NONE ((size_t)-1)
#define NSVCD_MAX_JOINTS 32

// Two bodies that can meet, by their indices.
typedef struct nsvcd_body_pair {
  uint32_t a, b;
} nsvcd_body_pair;

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
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
} nsvcd_check_options;

typedef struct nsvcd_check_answer {
  // FREE: at no time of the motion do two parts of a pair come within the clearance. HIT: two do,
  // or one is inside of the other, in the configuration that is named
  nsvcd_verdict verdict;
  nsvcd_why why;
  // of the scene's pairs, and where in the motion: of a HIT, or of what is UNDECIDED. NSVCD_NONE
  // where there is none
  size_t pair, piece;
  // of the piece, in [0,1]
  double share;
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
//   errors     ARGUMENT (NULL, counts, an axis of no length, limits that cross, a joint on a link
//              that comes after it, a pair of what never moves apart), NUMBER (not finite), POSE,
//              SCALE, BODY (without triangles), WORKSPACE
NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker);

// Where the parts are.
//   joints     (F), radians or metres; not looked at: NaN gives poses that are none
//   poses      (B), in the world
NSVCDDEF void nsvcd_checker_place(const nsvcd_checker *checker, const double *joints,
                                  nsvcd_pose *poses);

// Is a motion free?
//   checker    not NULL; where things are hit is remembered: it is asked there first
//   motion     not NULL
//   options    NULL: the defaults
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, NUMBER (points not finite or beyond NSVCD_MAX_COORDINATE), TOLERANCE
//   source     this library: robot/stray; slerps and lines against joints, by second derivatives
//
// What FREE says holds for the joints' own motion, with all joint values and frames exact, and
// bodies as nsvcd_sweep says. A HIT is one of the configuration named.
NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer);
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------ interface/postures
// In: a robot in one configuration. Out: what is near, how that changes with the joints, a way out;
// who can meet whom at all; a part as another link would carry it.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// Two parts of a pair that are near each other.
typedef struct nsvcd_gap {
  // of the scene's
  size_t pair;
  // HIT: they touch, or one is inside of the other; FREE: they are apart; UNDECIDED, and why: too
  // near to tell, or too little work
  nsvcd_verdict verdict;
  nsvcd_why why;
  // metres: no less than `low`, no more than `high`
  nsvcd_range distance;
  // metres, of a HIT: a lift of a by this along the contact's normal is proven to part them; hardly
  // less does, along that normal. HUGE_VALF: none up to options.deepest along each normal was
  // found, as where one is inside of the other or held from all sides. 0 of all others
  float depth;
  // where they are nearest, as nsvcd_answer.nearest has it; of a HIT, where they are once they are
  // lifted, with the lift's direction as the normal
  nsvcd_contact contact;
  // (F), metres by radian or metre: how the distance between the two places of the contact grows
  // with each joint; of a HIT, how its depth along that normal shrinks. Where other places are as
  // near, or as deep, it is that of one of them. 0 without a normal
  double slope[NSVCD_MAX_JOINTS];
} nsvcd_gap;

// What is zero is the default. Up to NSVCD_MAX_COORDINATE.
typedef struct nsvcd_gap_options {
  // metres: pairs that are as near as this are told; 0.05
  float within;
  // metres: how wide a bracket of a distance may be, beside both bodies' quanta and what poses in
  // float are off; 20 um
  float to;
  // metres: how large a depth is told; 20 mm. Much more than there is makes it no better
  float deepest;
  // units that each question may take; NSVCD_DEFAULT_WORK
  size_t work;
} nsvcd_gap_options;

// All pairs that are near in a configuration: what is wrong with a start or a goal, or what a
// controller is to keep away from.
//   checker    not NULL
//   joints     (F), radians or metres
//   options    NULL: the defaults
//   gaps       (capacity), not NULL unless that is 0; in the order of the pairs. scene.pair_count
//              is always enough. Some may be written on failure
//   count      not NULL: how many there are; where that is more than the capacity, the first are
//              written
//   allocates  nothing
//   threads    each with a checker of its own, as all of this page
//   errors     ARGUMENT, NUMBER (joints not finite or beyond NSVCD_MAX_COORDINATE), TOLERANCE;
//              POSE, SCALE (a part is, or is carried, beyond NSVCD_MAX_COORDINATE)
//   source     this library; slopes by the product of the axis and the lever, as any Jacobian's
NSVCDDEF nsvcd_result nsvcd_gaps(nsvcd_checker *checker, const double *joints,
                                 const nsvcd_gap_options *options, nsvcd_gap *gaps,
                                 size_t capacity, size_t *count);

// What is zero is the default.
typedef struct nsvcd_escape_options {
  // metres: the configuration that is sought stays farther apart than this
  float clearance;
  // radians and metres alike: how far it may be, as the root of the sum of squares; 0.5
  double farthest;
  // of the random numbers
  uint64_t seed;
} nsvcd_escape_options;

// A configuration near another one that is proven free, within the limits: a way out of a start or
// a goal that is not. It is sought at random, nearer and nearer, with some hundred configurations,
// and drawn back as far as that can be. What lies in between need not be free.
//   checker    not NULL
//   joints     (F), radians or metres; out of the limits, they are taken in first, and what follows
//              is about these
//   options    NULL: the defaults
//   out        (F), not NULL; the joints themselves where these are free. Left as it was where none
//              is found
//   is_found   not NULL
//   allocates  nothing
//   errors     ARGUMENT, NUMBER, TOLERANCE; POSE, SCALE, as nsvcd_gaps
//   source     this library
NSVCDDEF nsvcd_result nsvcd_escape(nsvcd_checker *checker, const double *joints,
                                   const nsvcd_escape_options *options, double *out,
                                   int *is_found);

// What nsvcd_find_pairs says of pairs: how many of which kind, in this order.
typedef struct nsvcd_pair_counts {
  // to be asked
  size_t asked;
  // of parts on two links that one joint parts, neither of them the world
  size_t adjacent;
  // of others: they touch in all configurations that were tried, which is no proof that they always
  // do
  size_t touching;
} nsvcd_pair_counts;

// Which pairs of parts are to be asked? All on links that differ, but adjacent ones, which joints
// are made to keep apart or to overlap, and those that always touch. These are told too: ask them
// where that is not so. None is left out for it seems never to meet: that costs little.
//   checker    of the parts and joints, whatever pairs its scene has
//   samples    random configurations within the limits, at most, that a pair is looked at in; 0: 64
//   seed       of them
//   pairs      (capacity), not NULL unless that is 0; some may be written on failure
//   capacity   B (B - 1) / 2 is always enough, of B parts
//   counts     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, WORKSPACE (capacity); POSE, SCALE, as nsvcd_gaps
//   source     as setup assistants do (MoveIt's), but none is left out as "never"
NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t samples, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts);

// A part as another link would carry it from where it is: to take hold of a thing, or, on link 0,
// to let go of it. Put it into the scene, say which pairs are asked now, and open a checker.
//   joints     (F), where it is taken over
//   part       which, of the scene's
//   link       the new one; 0: the world
//   out        not NULL; left as it was on failure. It is where it was to what a pose in float is
//              off: 1e-7 of its distance from the link
//   errors     ARGUMENT, NUMBER, POSE (farther than NSVCD_MAX_COORDINATE from the link)
NSVCDDEF nsvcd_result nsvcd_hand_over(const nsvcd_checker *checker, const double *joints,
                                      size_t part, uint32_t link, nsvcd_part *out);
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// -------------------------------------------------------------------------------- interface/routes
// In: a robot among obstacles, a configuration and others to get to. Out: a motion, proven free.
//
// A route is sought by proofs: a straight line, then two trees of edges that are proven free; its
// way is made shorter, timed, and smoothed within the limits of speed and acceleration, and all of
// it is proven as it is handed out.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// of a route's trees
#define NSVCD_MAX_NODES 10000000

typedef enum nsvcd_route_status {
  // the motion is proven free, within the limits, and ends at a goal
  NSVCD_ROUTE_FOUND = 0,
  // as many nodes as options allow, and no way; or one of more than 680 corners, as a guess may be
  NSVCD_ROUTE_LIMIT,
  // by the caller
  NSVCD_ROUTE_STOPPED,
  // the start, or every goal, is out of limits, or not proven free: answer.check says why
  NSVCD_ROUTE_START,
  NSVCD_ROUTE_GOAL
} nsvcd_route_status;

// A status in a word or two, for a person; never NULL.
NSVCDDEF const char *nsvcd_route_status_string(nsvcd_route_status status);

typedef struct nsvcd_route_problem {
  // (F)
  const double *start;
  // (G, F); one is enough
  const double *goals;
  size_t goal_count;
  // (W, F), from the start to a goal, these left out: a way that may be free, or nearly. NULL: none
  const double *guess;
  size_t guess_count;
  // asked before each proof; not 0 ends the search. What is found by then is not given up. May be
  // NULL
  int (*stop)(void *user);
  void *user;
} nsvcd_route_problem;

// What is zero is the default.
typedef struct nsvcd_route_options {
  // of all random numbers: threads with seeds of their own seek ways of their own
  uint64_t seed;
  // metres: the whole motion stays farther apart than this
  float clearance;
  // of the trees, at most; 20,000
  size_t nodes;
  // radians or metres that an edge is long, at most; 1
  double edge;
  // tried on the way, up to NSVCD_MAX_NODES, and on the timed motion; 20 and 200. NSVCD_NONE: none
  size_t shortcuts, smoothings;
} nsvcd_route_options;

typedef struct nsvcd_route_answer {
  nsvcd_route_status status;
  // FOUND: which one is reached
  size_t goal;
  // of degree 2, with times, at rest at both ends; in the memory that was given. Of no pieces where
  // the goal is the start. Of what is FOUND
  nsvcd_joint_motion motion;
  // times within that it rests at, for want of a smooth way round a corner
  size_t stops;
  // seconds: of the motion; and of the straight line if nothing were in its way
  double duration, unhindered;
  // of FOUND: the last proof. Of START and GOAL: what is wrong with it, of the last goal
  nsvcd_check_answer check;
  // of the trees; motions asked about, and those of them that were free
  size_t nodes, checks, proven;
} nsvcd_route_answer;

// Bytes that nsvcd_route needs; 0 if the problem or the options are refused.
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_route_size(const nsvcd_checker *checker,
                                 const nsvcd_route_problem *problem,
                                 const nsvcd_route_options *options);

// Seeks a motion from the start to a goal on which no pair meets. The same problem and seed, the
// same motion, as long as the checker is opened anew for each: it remembers what was hit last.
//   checker    not NULL
//   problem    not NULL
//   options    NULL: the defaults
//   memory     (size) bytes, nsvcd_route_size(checker, problem, options) or more, not NULL, aligned
//              to NSVCD_ALIGNMENT; the motion is in it
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (NULL, counts), NUMBER (a configuration not finite or beyond
//              NSVCD_MAX_COORDINATE), TOLERANCE, WORKSPACE
//   source     RRT-Connect (Kuffner and LaValle 2000); bounded-acceleration shortcuts (Hauser and
//              Ng-Thow-Hing 2010); with proofs in place of samples: this library
NSVCDDEF nsvcd_result nsvcd_route(nsvcd_checker *checker, const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, void *memory,
                                  size_t size, nsvcd_route_answer *answer);
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// --------------------------------------------------------------------------------- interface/plans
// In: a planning problem, or control points. Out: control points, or what the joints are at a time.
//
// A trajectory of F joints is a spline through control points: the start, M via points, the goal,
// control (M + 2, F), uniform in t in [0,1]. Between two points it is of degree five. At via points
// it has the velocity and the acceleration of central differences, and it is at rest at both ends;
// so both are continuous everywhere.

#ifndef NSVCD_NO_OPTIMIZER
#define NSVCD_MAX_VIA_POINTS 32
// of a stage of the planner
#define NSVCD_MAX_PLAN_SEGMENTS 4096

// The joints at a time, or their derivatives by t.
//   control    (via_points + 2, joints), not NULL
//   via_points M, up to NSVCD_MAX_VIA_POINTS; of more, nothing is written
//   t          taken into [0,1]
//   derivative 0: the joints; 1, 2, 3: velocity, acceleration, jerk; of more, nothing is written
//   out        (joints), not NULL
//   allocates  nothing
//   source     quintic Hermite interpolation, as the paper's authors use it
NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out);

typedef enum nsvcd_plan_status {
  // the trajectory is within the limits and free of collision: certified where bodies have
  // triangles, else as far as the network knows; but for what it strays from the last check's
  // motion, answer.stray
  NSVCD_PLAN_CONVERGED = 0,
  // the iterations ended before one was found; this is the best
  NSVCD_PLAN_LIMIT,
  // by the progress callback; this is the best so far
  NSVCD_PLAN_CANCELLED,
  // the start is out of the limits or in collision: control is the smoothest way to the goal
  NSVCD_PLAN_START,
  // the goal is out of the limits or in collision: so again
  NSVCD_PLAN_GOAL
} nsvcd_plan_status;

// A status in a word or two, for a person; never NULL.
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status);

typedef struct nsvcd_plan_progress {
  // from 0
  size_t seed, iteration;
  // of this stage; L-BFGS begins anew where the proof found a hit
  size_t iterations;
  // 0: MPPI, 1: L-BFGS
  int refining;
  // of the best trajectory of this stage. Stages look at different poses: their costs do not
  // compare
  float cost;
  // the part of it that is due to collision: at 0 it is free, as far as the stage's segments show
  float collision;
  // (via_points + 2, F), valid during the call
  const float *control;
  size_t via_points;
} nsvcd_plan_progress;

// A scene: who moves how, and who can meet whom. Nothing else is looked at. One `user` serves all
// callbacks; these must depend on nothing but their arguments and it.
typedef struct nsvcd_plan_problem {
  // F, 1..NSVCD_MAX_JOINTS
  size_t joints;
  // (F), limits
  const float *low, *high;
  // (F)
  const float *start, *goal;
  // (B), up to 65536, with latents; ones in no pair may be NULL
  const nsvcd_body *const *bodies;
  size_t body_count;
  // (P). The planner asks about a's motion as seen from b: take the body that rests, or else the
  // larger one, as b, for the other way round costs a little accuracy
  const nsvcd_body_pair *pairs;
  size_t pair_count;
  // joints (F) -> poses (B), in the world. What is grasped moves with the hand because this says
  // so: nothing is encoded anew
  void (*place)(void *user, const float *joints, nsvcd_pose *poses);
  // joints (F) -> jacobian (B, 6, F): of each body, by a joint, the displacement of its origin and
  // its rotation vector, in the world's axes. NULL: by differences of `place`
  void (*jacobian)(void *user, const float *joints, float *jacobian);
  // Instead of the network: the cost of collision of poses (T, B) at T times along the trajectory.
  // It may end at the first sum above `limit`. Sets *collides if there is a collision. Unless
  // `gradient` is NULL, adds the cost's derivative to it, (T, B, 6), as nsvcd_sweep_gradient has
  // it. NULL: the network
  float (*collision)(void *user, const nsvcd_pose *poses, size_t times, float limit,
                     int *collides, float *gradient);
  // once in each iteration; not 0 cancels. May be NULL
  int (*progress)(void *user, const nsvcd_plan_progress *progress);
  void *user;
} nsvcd_plan_problem;

// What is zero is the stage's default.
typedef struct nsvcd_plan_stage {
  // M, up to NSVCD_MAX_VIA_POINTS
  size_t via_points;
  // of the trajectory, each swept as one motion; with `discrete`, their ends are looked at; up to
  // NSVCD_MAX_PLAN_SEGMENTS
  size_t segments;
  // at most, up to 100000; NSVCD_NONE: leave the stage out
  size_t iterations;
  // random trajectories in an iteration of MPPI, or gradients in a bundle of L-BFGS; up to 10000
  size_t draws;
  // their standard deviation about the trajectory, radians or metres: MPPI's at mid-motion, at
  // first; of L-BFGS's bundle at all via points. Negative: 0
  float noise;
} nsvcd_plan_stage;

// What is zero is the default, which stands last; weights that are negative count as zero. If an
// exact check finds contacts, raise sweep.network.recall, `collision` or the bodies' number of
// patches; if the status is LIMIT, `seeds` or explore.draws. The smoothness counts radians and
// metres alike: for ways of hundreds of metres, raise `duration` or `collision`.
typedef struct nsvcd_plan_options {
  // of all random numbers
  uint64_t seed;
  // starts, tried until one ends free, up to 1000; 6
  size_t seeds;
  // MPPI: 5 via points, 24 segments, 40 iterations, 100 draws, noise 0.3
  nsvcd_plan_stage explore;
  // L-BFGS: 10, 22, 10, 10, 0.01
  nsvcd_plan_stage refine;
  // weights of the means of squares over the motion: 10, 2, 10
  float velocity, acceleration, jerk;
  // weight of the logits' sum over pairs and segments: 20; the paper's is 1
  float collision;
  // seconds from start to goal, which only weights the terms above: 20
  float duration;
  // logits above minus this cost: 2
  float margin;
  // 1: poses instead of sweeps
  int discrete;
  // segments of the last check, up to 4 NSVCD_MAX_PLAN_SEGMENTS; 16 times the finest stage's, or
  // that limit. Limits are looked at between these and at via points. Twice as many take
  // answer.stray to a quarter
  size_t check;
  // how all questions are asked; sweep.network.recall = 0.999f keeps more distance. The search asks
  // the network. `method` is that of start, goal and the last check, and so are `clearance`, `skin`
  // and the like. Not read: a, b, ask, to and to_time
  nsvcd_question sweep;
} nsvcd_plan_options;

typedef struct nsvcd_plan_answer {
  nsvcd_plan_status status;
  // by the last check, or of the start or the goal where the status says so
  int collides;
  // that leaves its limits, or NSVCD_NONE
  size_t joint;
  // of the greatest logit, or NSVCD_NONE
  size_t pair;
  // greatest of the last check; with a custom cost of collision that cost
  float logit;
  // of that logit, in [0,1]
  float time;
  // metres that the spline strays from the motion of the last check, through whose poses it goes:
  // the farthest of any point of a's bounding sphere, as b sees it. Of all pairs whose a is given,
  // with a custom cost of collision too. Measured, not proven: half way between two poses, where a
  // smooth curve strays most, at 16 places or more of each piece of the spline. 0 where no
  // trajectory was sought
  float stray;
  // of the trajectory, the latter without collision and limits; 0 where none was sought
  float cost, smoothness;
  // M of `control`
  size_t via_points;
  // used; the latter of both stages
  size_t seeds, iterations;
  // that were costed
  size_t trajectories;
  // queries asked
  size_t sweeps;
} nsvcd_plan_answer;

// Bytes of the workspace that nsvcd_plan needs; 0 if problem or options are refused, or if it were
// more than SIZE_MAX.
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options);

// Finds a smooth trajectory from start to goal on which no pair meets. The same problem, the same
// trajectory, in one build: see DETERMINISM above.
//   problem    not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_plan_workspace_size(problem, options) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   control    (M + 2, F), not NULL, with the M of options.refine, or of explore if that is left
//              out; NSVCD_MAX_VIA_POINTS + 2 rows are always enough. Written whatever the status
//              is; not on failure
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each with its own workspace; they may share bodies
//   errors     ARGUMENT (NULL, sizes, options, a lower limit above the upper one), NUMBER (limits,
//              start or goal not finite or beyond NSVCD_MAX_COORDINATE; a cost beyond the range of
//              float), POSE (from `place`), WORKSPACE, TOO_LARGE, and those of the queries
//   source     MPPI (Williams et al. 2017), then L-BFGS with bundled gradients (Suh et al. 2022);
//              NeuralSVCD, appendix D
//
// Start, goal and the trajectory at the end are proven free where bodies have triangles: for the
// motion of each pair as seen from b between the poses of the check's segments, position linear and
// rotation slerp. The spline goes through these poses, and in between strays from that motion by
// answer.stray, which nothing proves: to have the spline itself clear, by measure, ask for a
// sweep.clearance above that. With `discrete`, or a cost of collision of one's own, nothing is
// proven between the poses.
//
// Where the proof finds a hit, the refinement goes on from there with twice the margin and a little
// more, three times at most. It ends within seeds * (iterations of MPPI + 4 times those of L-BFGS)
// iterations, each of `draws` trajectories, and for L-BFGS of 5 more.
NSVCDDEF nsvcd_result nsvcd_plan(const nsvcd_plan_problem *problem,
                                 const nsvcd_plan_options *options, void *workspace,
                                 size_t workspace_size, float *control,
                                 nsvcd_plan_answer *answer);
#endif  // NSVCD_NO_OPTIMIZER

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

// --------------------------------------------------------------------------------- ground/compiler
// In: the compiler at hand. Out: libc and libm, and three words of how a function is merged into
// its callers.

#ifdef __TINYC__  // 0.9.27: where a struct and a float that calls return are passed together
#error "neuralsvcd.h: tcc passes arguments wrongly, and certificates would be false"
#endif
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifndef NSVCD_NO_STDIO
#include <stdio.h>
#endif
// NSVCD_ONE_PATH: nothing may be fused or reckoned more exactly than it is written.
#ifdef NSVCD_ONE_PATH
#include <float.h>
#if defined(__FAST_MATH__) || (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16)
#error \
    "neuralsvcd.h: NSVCD_ONE_PATH: not with -ffast-math, nor where floats are reckoned in double"
#endif
// gcc has a flag for it, and a pragma that makes all slower by an order of magnitude.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif
#endif
// gcc 12 fuses, whatever it is told, where sums and differences of products stand side by side
// (vfmaddsub). Functions in which they do.
#if defined(NSVCD_ONE_PATH) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNFUSED \
  static __attribute__((noinline, unused, optimize("no-tree-slp-vectorize")))
#else
#define NSVCD__UNFUSED static inline
#endif
// Functions that take more of the stack, and of flash, called than merged into their callers.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__MERGED static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define NSVCD__MERGED static __forceinline
#else
#define NSVCD__MERGED static inline
#endif
// Functions whose loops over constant arguments must be unrolled: left to its own measure, gcc may
// not inline them, and the decoder takes four times as long (tests/bench/PERFORMANCE.md).
#ifdef __OPTIMIZE_SIZE__
#define NSVCD__INLINE static inline
#else
#define NSVCD__INLINE NSVCD__MERGED
#endif
// Functions that must not be inlined: what they take of the stack would add up.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__APART __attribute__((noinline))
#elif defined(_MSC_VER)
#define NSVCD__APART __declspec(noinline)
#else
#define NSVCD__APART
#endif
#if defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNROLL _Pragma("GCC unroll 8")  // at -O2 too, so that sums stay in registers
#else
#define NSVCD__UNROLL
#endif

// ---------------------------------------------------------------------------------- ground/strings
// In: a code or a verdict. Out: what it says, in English.

// Number n of texts that follow each other, in the order of enumerators; the last where there is
// none. No table of pointers: a loader would write into that.
static const char *nsvcd__text_of(const char *texts, size_t n) {
  for (; n > 0 && texts[strlen(texts) + 1]; n--) texts += strlen(texts) + 1;
  return texts;
}

NSVCDDEF const char *nsvcd_result_string(nsvcd_result result) {
  return nsvcd__text_of(
      "ok\0"
      "an argument is NULL or out of its range\0"
      "the file is missing or cannot be read\0"
      "out of memory\0"
      "a line cannot be understood, or a face has fewer than three corners\0"
      "an index is zero or refers to no vertex\0"
      "a coordinate is not finite, or beyond a million metres\0"
      "there is no triangle, or no area, or the mesh is smaller than 1e-12 metres\0"
      "more vertices, triangles or bytes than can be counted\0"
      "a pose is not finite, or its quaternion is not of unit length\0"
      "a scale is not finite, negative or out of range, or makes a body too small or too "
      "large\0"
      "a tolerance or a clearance is negative, not finite or beyond the scene\0"
      "both sides are the same body in the same motion\0"
      "the body is damaged, cut short, misaligned, of another version, model or byte "
      "order, or lacks what the method needs\0"
      "the memory given is too small or misaligned\0"
      "cancelled\0"
      "this build reckons wrongly: see the compiler, and its flags\0"
      "unknown result\0",
      (size_t)result);
}

NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict) {
  return nsvcd__text_of(
      "undecided\0"
      "free\0"
      "hit\0"
      "unknown verdict\0",
      (size_t)verdict);
}

#ifndef NSVCD_NO_OPTIMIZER
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status) {
  return nsvcd__text_of(
      "converged\0"
      "limit\0"
      "cancelled\0"
      "infeasible start\0"
      "infeasible goal\0"
      "unknown status\0",
      (size_t)status);
}
#endif

// ----------------------------------------------------------------------------------- ground/angles
// In: angles up to a quarter turn, and lengths. Out: sines, and angles. With NSVCD_ONE_PATH they
// are reckoned here, for libm's last digit is not the same everywhere; else by libm.

#ifdef NSVCD_ONE_PATH
// sin x, 0 <= x <= pi / 2, to 1e-15: what is left of the series is less than 2e-18.
static inline double nsvcd__sin(double x) {
  const double square = x * x;
  double sum = 1;
  for (int n = 20; n > 0; n -= 2) sum = 1 - sum * (square / (n * (n + 1)));
  return x * sum;
}
// The angle of a vector (x, y), neither below 0, to 1e-15: a quarter of it, twice halved by
// tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a)), is less than 0.2, and of the series there 1e-18 is
// left.
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
// 0 <= x < 1
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

// ------------------------------------------------------------------------------------- ground/bits
// In, out: whole numbers: bits that are set, sizes that are rounded up, floats on their bits.

// Index of the lowest bit that is set, of a number that is not 0; how many are set.
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

// |x| as bits, in the order of |x|; infinity and NaN are above all numbers.
static uint32_t nsvcd__magnitude(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits & 0x7fffffffu;
}
static inline int nsvcd__is_finite(float x) {
  return nsvcd__magnitude(x) < 0x7f800000u;
}

// ----------------------------------------------------------------------------------- ground/points
// In, out: vectors of three numbers, as values: f3 of floats, d3 of doubles. A box is two corners.

// The greater, or the less, of two; where there is a NaN, b. fmax and fmin, which look for NaN, are
// calls with most compilers.
static inline double nsvcd__max(double a, double b) {
  return a > b ? a : b;
}
static inline double nsvcd__min(double a, double b) {
  return a < b ? a : b;
}

// The algebra of f3 and of d3: NSVCD__VECTORS(nsvcd__f3, float, sqrtf) writes nsvcd__f3_add and so
// on. _load and _row are from floats, of which a row has three; _fma(s, b, a) is s b + a, rounded
// twice. Of floats a difference, and all that is built of a few of them, is as good as exact in
// double.
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
  static inline scalar t##_length(t a) { \
    return sqrt(t##_dot(a, a)); \
  }
NSVCD__VECTORS(nsvcd__f3, float, sqrtf)
NSVCD__VECTORS(nsvcd__d3, double, sqrt)
#undef NSVCD__VECTORS

// ---- of floats

// From, and to, rows of x, y and z, so many numbers apart.
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
// Is a component of a greater than b's?
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
// Of length 1; `otherwise` if a has none.
static inline nsvcd__d3 nsvcd__d3_unit(nsvcd__d3 a, nsvcd__d3 otherwise) {
  const double length = nsvcd__d3_length(a);
  return length > 0 ? nsvcd__d3_scale(a, 1 / length) : otherwise;
}
// Rounds for certain. gcc 12 at -O2 forgets to where two doubles side by side become floats and
// doubles again: it takes the two conversions of a vector for none, and a proof built on what is
// stored would not hold. clang 14 for WebAssembly, in turn, reads a volatile number that fills a
// vector once more, when another one may have taken its place.
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

// -------------------------------------------------------------------------------- ground/rotations
// In, out: rotations, as values: quat and mat3 of floats, dquat and dmat3 of doubles. A matrix is
// its rows. A transform is a rotation and a place.

// The algebra of both: NSVCD__ROTATIONS(nsvcd__quat, nsvcd__mat3, nsvcd__f3, float, sqrtf) writes
// nsvcd__quat_dot, nsvcd__mat3_apply and so on. _fma(s, b, a) is s b + a; _axis is that of a unit
// quaternion, times the sine of half its angle; _of is the matrix of a unit quaternion;
// _apply_transpose is the transpose of m, times a.
#define NSVCD__ROTATIONS(quat, mat, vec, scalar, sqrt) \
  typedef struct quat { \
    scalar x, y, z, w; \
  } quat; \
  typedef struct mat { \
    vec x, y, z; \
  } mat; \
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
  NSVCD__MERGED quat quat##_unit(quat q) { \
    return quat##_scale(q, 1 / sqrt(quat##_dot(q, q))); \
  } \
  static inline vec quat##_axis(quat q) { \
    return vec##_of(q.x, q.y, q.z); \
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
  }
NSVCD__ROTATIONS(nsvcd__quat, nsvcd__mat3, nsvcd__f3, float, sqrtf)
NSVCD__ROTATIONS(nsvcd__dquat, nsvcd__dmat3, nsvcd__d3, double, sqrt)
#undef NSVCD__ROTATIONS

// The inverse of a, unit, times b.
static inline nsvcd__dquat nsvcd__dquat_inverse_mul(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__d3 u = nsvcd__dquat_axis(a);
  const nsvcd__d3 v = nsvcd__dquat_axis(b);
  const nsvcd__d3 along = nsvcd__d3_sub(nsvcd__d3_scale(v, a.w), nsvcd__d3_scale(u, b.w));
  const nsvcd__d3 axis = nsvcd__d3_sub(along, nsvcd__d3_cross(u, v));
  const nsvcd__dquat out = {axis.x, axis.y, axis.z, a.w * b.w + nsvcd__d3_dot(u, v)};
  return out;
}

static inline nsvcd__dmat3 nsvcd__dmat3_scale(const nsvcd__dmat3 *m, double s) {
  const nsvcd__dmat3 out = {nsvcd__d3_scale(m->x, s), nsvcd__d3_scale(m->y, s),
                            nsvcd__d3_scale(m->z, s)};
  return out;
}

// ---- quaternions and matrices of floats

// A rotation and a position: a -> rotation a + position.
typedef struct nsvcd__transform {
  nsvcd__mat3 rotation;
  nsvcd__f3 position;
} nsvcd__transform;

static inline nsvcd__quat nsvcd__quat_of(float x, float y, float z, float w) {
  const nsvcd__quat out = {x, y, z, w};
  return out;
}
static inline nsvcd__quat nsvcd__quat_load(const float *p) {
  return nsvcd__quat_of(p[0], p[1], p[2], p[3]);
}
// To rows of x, y, z and w, so many numbers apart.
static inline void nsvcd__quat_put(nsvcd__quat q, float *rows, size_t stride) {
  rows[0] = q.x;
  rows[stride] = q.y;
  rows[2 * stride] = q.z;
  rows[3 * stride] = q.w;
}
static inline void nsvcd__quat_store(nsvcd__quat q, float *p) {
  nsvcd__quat_put(q, p, 1);
}

// Is the shorter arc from a to b the one to -b? Products of floats are exact in double, so that
// every machine and the exact poses of the proof say the same, also where the arcs are equally long
// to rounding.
static inline int nsvcd__quats_opposed(nsvcd__quat a, nsvcd__quat b) {
  double dot = (double)a.x * (double)b.x;
  dot += (double)a.y * (double)b.y;
  dot += (double)a.z * (double)b.z;
  dot += (double)a.w * (double)b.w;
  return dot < 0;
}

// The length of the arc from a to b in quaternion space: half the angle of rotation. [0, pi/2]
// where it is the shorter one. From the chord, because acos of a dot product near 1 has no digits
// left.
static inline float nsvcd__quat_arc(nsvcd__quat a, nsvcd__quat b) {
  const nsvcd__quat chord = nsvcd__quat_fma(-1, b, a);
  return 2 * nsvcd__asinf(0.5f * sqrtf(nsvcd__quat_dot(chord, chord)));
}

// The same rotation on the side of another quaternion, to which q is opposed or not.
static inline nsvcd__quat nsvcd__quat_beside(nsvcd__quat q, int opposed) {
  return opposed ? nsvcd__quat_of(-q.x, -q.y, -q.z, -q.w) : q;
}
// of a unit one
static inline nsvcd__quat nsvcd__quat_inverse(nsvcd__quat q) {
  return nsvcd__quat_of(-q.x, -q.y, -q.z, q.w);
}

// The rotation by b, then by a.
static inline nsvcd__quat nsvcd__quat_mul(nsvcd__quat a, nsvcd__quat b) {
  nsvcd__quat out;
  out.x = a.w * b.x + a.x * b.w + (a.y * b.z - a.z * b.y);
  out.y = a.w * b.y + a.y * b.w + (a.z * b.x - a.x * b.z);
  out.z = a.w * b.z + a.z * b.w + (a.x * b.y - a.y * b.x);
  out.w = a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z;
  return out;
}
// The turn from a to b, unit ones: its axis, times the sine of half its angle.
static inline nsvcd__f3 nsvcd__quat_turn(nsvcd__quat a, nsvcd__quat b) {
  return nsvcd__quat_axis(nsvcd__quat_mul(b, nsvcd__quat_inverse(a)));
}

// A share u of the way from a to b, on the shorter arc. a, b: unit to 1e-4.
static inline nsvcd__quat nsvcd__quat_slerp(nsvcd__quat a, nsvcd__quat b, float u) {
  const int opposed = nsvcd__quats_opposed(a, b);
  const nsvcd__quat start = nsvcd__quat_unit(a);
  const nsvcd__quat end = nsvcd__quat_beside(nsvcd__quat_unit(b), opposed);
  const float angle = nsvcd__quat_arc(start, end);
  float wa = 1 - u;
  float wb = u;
  // below, the difference is less than rounding
  if (angle > 1e-3f) {
    wa = nsvcd__sinf((1 - u) * angle);
    wb = nsvcd__sinf(u * angle);
  }
  return nsvcd__quat_unit(nsvcd__quat_fma(wb, end, nsvcd__quat_scale(start, wa)));
}

// s (a + t b).
static inline nsvcd__mat3 nsvcd__mat3_mix(float s, const nsvcd__mat3 *a, float t,
                                          const nsvcd__mat3 *b) {
  const nsvcd__mat3 out = {nsvcd__f3_scale(nsvcd__f3_fma(t, b->x, a->x), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->y, a->y), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->z, a->z), s)};
  return out;
}
static inline nsvcd__mat3 nsvcd__mat3_mul(const nsvcd__mat3 *a, const nsvcd__mat3 *b) {
  const nsvcd__mat3 columns = nsvcd__mat3_transpose(*b);
  const nsvcd__mat3 out = {nsvcd__mat3_apply(&columns, a->x),
                           nsvcd__mat3_apply(&columns, a->y),
                           nsvcd__mat3_apply(&columns, a->z)};
  return out;
}
static inline nsvcd__f3 nsvcd__f3_transform(const nsvcd__transform *t, nsvcd__f3 a) {
  return nsvcd__f3_add(nsvcd__mat3_apply(&t->rotation, a), t->position);
}

// ---------------------------------------------------------------------------------- ground/spheres
// In: rows of floats, as a body stores them. Out: one sphere, or one disc, as a value.

typedef struct nsvcd__sphere {
  nsvcd__f3 centre;
  float radius;
} nsvcd__sphere;

// Many of them, in arrays that follow each other: x, y, z and radii.
typedef struct nsvcd__spheres {
  const float *x, *y, *z, *r;
} nsvcd__spheres;

static inline nsvcd__spheres nsvcd__spheres_of(const float *first, size_t slots) {
  const nsvcd__spheres out = {first, first + slots, first + 2 * slots, first + 3 * slots};
  return out;
}
static inline nsvcd__spheres nsvcd__spheres_from(nsvcd__spheres all, size_t i) {
  const nsvcd__spheres out = {all.x + i, all.y + i, all.z + i, all.r + i};
  return out;
}
static inline nsvcd__f3 nsvcd__centre_of(nsvcd__spheres all, size_t i) {
  return nsvcd__f3_of(all.x[i], all.y[i], all.z[i]);
}
static inline nsvcd__sphere nsvcd__sphere_of(nsvcd__spheres all, size_t i) {
  const nsvcd__sphere out = {nsvcd__centre_of(all, i), all.r[i]};
  return out;
}
// Writes the i-th of spheres in arrays of so many slots.
static inline void nsvcd__sphere_store(nsvcd__sphere sphere, float *first, size_t slots,
                                       size_t i) {
  nsvcd__f3_put(sphere.centre, first + i, slots);
  first[3 * slots + i] = sphere.radius;
}

// ---- discs

// Points x about a centre have low <= normal.x <= high, and are no farther than `across` from the
// line along the normal, which is no longer than 1.
typedef struct nsvcd__disc {
  nsvcd__f3 normal;
  float low, high, across;
} nsvcd__disc;

// Disc i of (6, stride).
static inline nsvcd__disc nsvcd__disc_at(const float *discs, size_t stride, size_t i) {
  const float *d = discs + i;
  nsvcd__disc out;
  out.normal = nsvcd__f3_get(d, stride);
  out.low = d[3 * stride];
  out.high = d[4 * stride];
  out.across = d[5 * stride];
  return out;
}
static inline void nsvcd__disc_store(nsvcd__disc disc, float *discs, size_t stride, size_t i) {
  float *d = discs + i;
  nsvcd__f3_put(disc.normal, d, stride);
  d[3 * stride] = disc.low;
  d[4 * stride] = disc.high;
  d[5 * stride] = disc.across;
}

// ----------------------------------------------------------------------------------- ground/random
// In: a state. Out: random numbers, the same from the same state.

// In (0, 1]: splitmix64.
static inline double nsvcd__random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) * 1.1102230246251565e-16 + 5.5e-17;
}

// ----------------------------------------------------------------------------------- ground/memory
// In: the caller's allocator, or the workspace. Out: arrays from either; NULL, or a count alone,
// where there is no memory.

#ifndef NSVCD_NO_ENCODER
static void *nsvcd__alloc(const nsvcd_allocator *allocator, size_t size) {
  return allocator ? allocator->alloc(size, allocator->user) : malloc(size);
}
static void nsvcd__free(const nsvcd_allocator *allocator, void *memory) {
  if (allocator && memory) allocator->free(memory, allocator->user);
  if (!allocator) free(memory);
}
// count * size bytes; NULL also where that product cannot be counted.
static void *nsvcd__alloc_array(const nsvcd_allocator *allocator, size_t count, size_t size) {
  return count > SIZE_MAX / size ? NULL : nsvcd__alloc(allocator, count * size);
}

// Arrays that are given back together. Where one cannot be had, `failed` says so: who takes several
// asks once, after the last.
typedef union nsvcd__header {
  union nsvcd__header *next;
  double aligned;
} nsvcd__header;
typedef struct nsvcd__arena {
  const nsvcd_allocator *allocator;
  // an array behind each
  nsvcd__header *last;
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

// Room for an array; NULL without memory.
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

// Room in place of an array (NULL: none), of which it keeps the first `used` bytes; without memory
// that stays.
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

// The next rows of a workspace, or, where base is NULL, only counts their bytes: in 64 bits, for
// they may be more than a machine of 32 bits can count.
static void *nsvcd__take(char *base, uint64_t *used, size_t rows, size_t row_size) {
  void *at = base ? base + *used : NULL;
  const uint64_t bytes = (uint64_t)rows * row_size;
  *used += (bytes + NSVCD_ALIGNMENT - 1) / NSVCD_ALIGNMENT * NSVCD_ALIGNMENT;
  return at;
}

// ----------------------------------------------------------------------------------- ground/slices
// In: what the compiler was told the processor has. Out: how many of 16 lanes a register holds.
//
// 16 floats side by side, lane by lane, for the sweep and the decoder. One set of operations over
// what the compiler was told the processor has; the plain path says what they mean. They differ in
// rounding only: fma rounds once or twice. NSVCD_NO_SIMD takes the plain path.

#define NSVCD__LANES 16
// Radius of padding: meets nothing, and its square is still finite. A float to the last digit, for
// it is looked for in blobs, also where constants are reckoned in double (FLT_EVAL_METHOD).
#define NSVCD__NOWHERE (-999999986991104.0f)
#define NSVCD__HULL NSVCD__LANES  // vertices of a patch's hull, at most
// of a listing: its triangle belongs to a closed component
#define NSVCD__ENCLOSES 0x80000000u

// The tests hold what a query does against the bound that nsvcd_sweep states.
#ifndef NSVCD__TALLY
#define NSVCD__TALLY(what, amount) ((void)0)
#endif

// What is done 16 lanes wide is done a *slice* at a time: as many lanes as a register holds. A
// function over 16 lanes goes through its slices in a loop, and keeps no more than one of them in
// its variables; on a machine without vectors a slice is one lane.

#ifndef NSVCD__ISA
// gcc on Windows puts what is wider than 16 bytes where the stack is not aligned for it, and the
// program ends there: its bug 54412.
#if defined(_WIN32) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__NARROW
#endif
#if defined(NSVCD_NO_SIMD)
#define NSVCD__SLICE 1
#elif defined(__AVX512F__) && !defined(NSVCD__NARROW)
#include <immintrin.h>
#define NSVCD__SLICE 16
#elif defined(__AVX2__) && (defined(__FMA__) || defined(_MSC_VER)) && !defined(NSVCD__NARROW)
#include <immintrin.h>
#define NSVCD__SLICE 8
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#define NSVCD__SLICE 4
#elif defined(__SSE2__) || defined(_M_X64)
#include <immintrin.h>
#define NSVCD__SLICE 4
#elif defined(__aarch64__)
#include <arm_neon.h>
#define NSVCD__SLICE 4
#else
#define NSVCD__SLICE 1
#endif
#if NSVCD__SLICE == 16 && defined(__AVX512VNNI__)
#define NSVCD__VNNI  // instructions that multiply bytes
#endif
#endif  // NSVCD__ISA

// ======================================================================= mesh: files and triangles

// --------------------------------------------------------------------------------------- mesh/mesh
// In: triangles. Out: nsvcd_mesh, every index in range, every coordinate finite; or what of it lies
// in a box.

#define NSVCD__MAX_COUNT 0x7fffffffu  // vertices and triangles: 2^31 - 1

#ifndef NSVCD_NO_ENCODER
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *allocator) {
  if (!mesh) return;
  nsvcd__free(allocator, mesh->positions);
  nsvcd__free(allocator, mesh->indices);
  memset(mesh, 0, sizeof *mesh);
}

// Room for vertices and triangles. 0 without memory; in either case nsvcd_mesh_free gives it back.
static int nsvcd__mesh_alloc(nsvcd_mesh *mesh, size_t vertices, size_t triangles,
                             const nsvcd_allocator *allocator) {
  const size_t row = 3 * sizeof(float);
  mesh->vertex_count = vertices;
  mesh->triangle_count = triangles;
  // + 1: a file may hold faces and no vertex, and malloc(0) may return NULL.
  mesh->positions = (float *)nsvcd__alloc_array(allocator, vertices + 1, row);
  mesh->indices = (uint32_t *)nsvcd__alloc_array(allocator, triangles, row);
  return mesh->positions && mesh->indices;
}

// A mesh may come from anywhere: everything below relies on what is checked here.
static nsvcd_result nsvcd__mesh_check(const nsvcd_mesh *mesh) {
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
  for (size_t i = 0; i < 3 * vertices; i++) {
    const float x = mesh->positions[i];
    if (!nsvcd__is_finite(x) || fabsf(x) > NSVCD_MAX_COORDINATE) return NSVCD_ERROR_NUMBER;
  }
  return NSVCD_OK;
}

// A triangle cut at the six sides of a box. Each side adds one corner, or two where roundings make
// the polygon cross it twice.
typedef struct nsvcd__clipped {
  nsvcd__d3 corners[3 + 2 * 6];
  size_t count;
} nsvcd__clipped;

// The part of triangle t within the box: 0, or 3 to 9 corners, but for roundings.
static nsvcd__clipped nsvcd__cut_triangle(const nsvcd_mesh *mesh, size_t t, const float *low,
                                          const float *high) {
  const uint32_t *triangle = mesh->indices + 3 * t;
  nsvcd__clipped out;
  for (out.count = 0; out.count < 3; out.count++)
    out.corners[out.count] = nsvcd__d3_row(mesh->positions, triangle[out.count]);
  for (size_t side = 0; side < 6; side++) {
    const size_t axis = side / 2;
    const double sign = side % 2 ? 1 : -1;
    const double bound = (double)(side % 2 ? high : low)[axis];
    const nsvcd__clipped from = out;
    out.count = 0;
    // what has sign * x[axis] <= sign * bound is kept
    for (size_t i = 0; i < from.count; i++) {
      const nsvcd__d3 a = from.corners[i];
      const nsvcd__d3 b = from.corners[(i + 1) % from.count];
      const double past_a = sign * (nsvcd__d3_axis(a, axis) - bound);
      const double past_b = sign * (nsvcd__d3_axis(b, axis) - bound);
      if (past_a <= 0) out.corners[out.count++] = a;
      if ((past_a <= 0) == (past_b <= 0)) continue;
      nsvcd__d3 *between = &out.corners[out.count++];
      *between = nsvcd__d3_mix(a, b, past_a / (past_a - past_b));
      nsvcd__d3_set_axis(between, axis, bound);
    }
    if (side % 2 && out.count < 3) out.count = 0;
  }
  return out;
}

NSVCDDEF nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *mesh, const float low[3],
                                     const float high[3], const nsvcd_allocator *allocator,
                                     nsvcd_mesh *part) {
  if (!low || !high || !part) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 3; k++) {
    const int finite = nsvcd__is_finite(low[k]) && nsvcd__is_finite(high[k]);
    if (!finite || !(low[k] < high[k])) return NSVCD_ERROR_ARGUMENT;
  }
  const nsvcd_result result = nsvcd__mesh_check(mesh);
  if (result) return result;

  size_t vertices = 0;
  size_t triangles = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const size_t corners = nsvcd__cut_triangle(mesh, t, low, high).count;
    vertices += corners;
    triangles += corners ? corners - 2 : 0;
  }
  if (vertices == 0) return NSVCD_ERROR_EMPTY;
  if (vertices > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  nsvcd_mesh out;
  if (!nsvcd__mesh_alloc(&out, vertices, triangles, allocator)) {
    nsvcd_mesh_free(&out, allocator);
    return NSVCD_ERROR_MEMORY;
  }

  out.vertex_count = 0;
  out.triangle_count = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__clipped polygon = nsvcd__cut_triangle(mesh, t, low, high);
    const uint32_t first = (uint32_t)out.vertex_count;
    for (size_t i = 0; i < polygon.count; i++) {
      const nsvcd__f3 corner = nsvcd__d3_narrow(polygon.corners[i]);
      nsvcd__f3_store(corner, out.positions + 3 * out.vertex_count++);
    }
    // a fan
    for (uint32_t i = 2; i < polygon.count; i++) {
      uint32_t *triangle = out.indices + 3 * out.triangle_count++;
      triangle[0] = first;
      triangle[1] = first + i - 1;
      triangle[2] = first + i;
    }
  }
  *part = out;
  return NSVCD_OK;
}
#endif

// ----------------------------------------------------------------------------------- mesh/polygons
// In: the corners of a face. Out: triangles, by ear clipping (Meisters 1975; after Eberly,
// "Triangulation by Ear Clipping").
//
// A face becomes corners - 2 triangles whose vector areas always sum to the polygon's. A simple
// polygon, concave or with holes cut open by a bridge, is covered without overlap; any other
// (crossing itself, no area) is cut somehow.
//
// An ear is a corner whose triangle holds no reflex corner. So that faces may have many corners,
// these are not all looked at: corners are sorted along a Z curve (Morton 1966), and each run of 8
// has a box, as have two boxes side by side, and so on up to one about all.

#ifndef NSVCD_NO_OBJ
#define NSVCD__RUN 8

// In the polygon's plane.
typedef struct nsvcd__d2 {
  double x, y;
} nsvcd__d2;

typedef struct nsvcd__corner {
  // the polygon is counter-clockwise
  nsvcd__d2 at;
  uint32_t vertex;
  // the ring of corners not yet clipped
  uint32_t previous, next;
  // 1: in the queue
  uint32_t queued;
  // 1: the inner angle exceeds 180 degrees
  uint32_t reflex;
  // the box of its run
  uint32_t box;
} nsvcd__corner;

typedef struct nsvcd__corner_box {
  nsvcd__d2 low, high;
  // corners in it that are reflex
  uint32_t reflex;
} nsvcd__corner_box;

typedef struct nsvcd__polygon {
  nsvcd__corner *corners;
  // (count): corners along the Z curve
  uint32_t *order;
  // (2 runs): box k is about boxes 2 k and 2 k + 1, the last are runs'
  nsvcd__corner_box *boxes;
  uint32_t count, runs;  // a power of two
  // (count), a ring: corners that may have become an ear
  uint32_t *queue;
  uint32_t queue_first, queue_length;
} nsvcd__polygon;

// Runs of so many corners, rounded up to a power of two.
static uint32_t nsvcd__runs_of(uint32_t corners) {
  uint32_t runs = 1;
  while (NSVCD__RUN * (uint64_t)runs < corners) runs *= 2;
  return runs;
}

// Room for polygons of up to so many corners. 0 without memory.
static int nsvcd__polygon_alloc(nsvcd__polygon *polygon, uint32_t corners,
                                nsvcd__arena *arena) {
  memset(polygon, 0, sizeof *polygon);
  polygon->corners = NSVCD__TAKE(arena, nsvcd__corner, corners);
  polygon->order = NSVCD__TAKE(arena, uint32_t, corners);
  polygon->queue = NSVCD__TAKE(arena, uint32_t, corners);
  polygon->boxes = NSVCD__TAKE(arena, nsvcd__corner_box, 2 * (size_t)nsvcd__runs_of(corners));
  return !arena->failed;
}

// Twice the area of abc, positive if counter-clockwise. In double a difference of floats is as good
// as exact.
static double nsvcd__d2_cross(nsvcd__d2 a, nsvcd__d2 b, nsvcd__d2 c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}
static int nsvcd__same_place(nsvcd__d2 a, nsvcd__d2 b) {
  return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y);
}

// Places the corners in a plane: drops the axis along which the normal is longest, and so keeps the
// coordinates exact.
static void nsvcd__polygon_project(nsvcd__polygon *polygon, const float *positions) {
  nsvcd__corner *corners = polygon->corners;
  // twice the area times the normal (Newell's)
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  const nsvcd__d3 origin = nsvcd__d3_row(positions, corners[0].vertex);
  for (uint32_t i = 0; i < polygon->count; i++) {
    const uint32_t next = corners[(i + 1) % polygon->count].vertex;
    const nsvcd__d3 p = nsvcd__d3_sub(nsvcd__d3_row(positions, corners[i].vertex), origin);
    const nsvcd__d3 q = nsvcd__d3_sub(nsvcd__d3_row(positions, next), origin);
    normal = nsvcd__d3_add(normal, nsvcd__d3_cross(p, q));
  }
  size_t axis = fabs(normal.y) > fabs(normal.x) ? 1 : 0;
  if (fabs(normal.z) > fabs(nsvcd__d3_axis(normal, axis))) axis = 2;
  const size_t turned = nsvcd__d3_axis(normal, axis) < 0;
  for (uint32_t i = 0; i < polygon->count; i++) {
    const float *p = positions + 3 * (size_t)corners[i].vertex;
    corners[i].at.x = (double)p[(axis + 1 + turned) % 3];
    corners[i].at.y = (double)p[(axis + 2 - turned) % 3];
  }
}

// Sorts corners along the Z curve, by this bit of it and those below: the bits of x and y in turn.
static void nsvcd__z_sort(const nsvcd__corner *corners, uint32_t *order, uint32_t count,
                          int bit) {
  if (count <= NSVCD__RUN || bit < 0) return;
  // where those begin that have the bit
  uint32_t ones = count;
  for (uint32_t i = 0; i < ones;) {
    const uint32_t corner = order[i];
    const nsvcd__d2 at = corners[corner].at;
    const float x = (float)(bit % 2 ? at.x : at.y);
    uint32_t key;
    memcpy(&key, &x, sizeof key);
    // grows with the coordinate
    key = key >> 31 ? ~key : key | 0x80000000u;
    if (key >> bit / 2 & 1) {
      order[i] = order[--ones];
      order[ones] = corner;
    } else {
      i++;
    }
  }
  nsvcd__z_sort(corners, order, ones, bit - 1);
  nsvcd__z_sort(corners, order + ones, count - ones, bit - 1);
}

static nsvcd__corner_box nsvcd__no_box(void) {
  const nsvcd__corner_box out = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0};
  return out;
}
static void nsvcd__box_take(nsvcd__corner_box *box, nsvcd__d2 at) {
  if (at.x < box->low.x) box->low.x = at.x;
  if (at.y < box->low.y) box->low.y = at.y;
  if (at.x > box->high.x) box->high.x = at.x;
  if (at.y > box->high.y) box->high.y = at.y;
}

// Puts the corners into boxes. None is known to be reflex yet.
static void nsvcd__polygon_box(nsvcd__polygon *polygon) {
  polygon->runs = nsvcd__runs_of(polygon->count);
  for (uint32_t k = 0; k < 2 * polygon->runs; k++) polygon->boxes[k] = nsvcd__no_box();
  for (uint32_t i = 0; i < polygon->count; i++) polygon->order[i] = i;
  nsvcd__z_sort(polygon->corners, polygon->order, polygon->count, 63);
  for (uint32_t i = 0; i < polygon->count; i++) {
    nsvcd__corner *c = &polygon->corners[polygon->order[i]];
    c->box = polygon->runs + i / NSVCD__RUN;
    for (uint32_t k = c->box; k > 0; k /= 2) nsvcd__box_take(&polygon->boxes[k], c->at);
  }
}

static void nsvcd__polygon_set_reflex(nsvcd__polygon *polygon, uint32_t i, uint32_t reflex) {
  nsvcd__corner *c = &polygon->corners[i];
  for (uint32_t k = c->box; k > 0 && c->reflex != reflex; k /= 2)
    polygon->boxes[k].reflex += reflex - c->reflex;
  c->reflex = reflex;
}

// Looks at corner i again, after a neighbour of it has changed.
static void nsvcd__polygon_update(nsvcd__polygon *polygon, uint32_t i) {
  nsvcd__corner *corners = polygon->corners;
  nsvcd__corner *c = &corners[i];
  const nsvcd__d2 previous = corners[c->previous].at;
  const nsvcd__d2 next = corners[c->next].at;
  nsvcd__polygon_set_reflex(polygon, i, nsvcd__d2_cross(previous, c->at, next) < 0);
  if (c->queued) return;
  c->queued = 1;
  polygon->queue[(polygon->queue_first + polygon->queue_length++) % polygon->count] = i;
}

// A triangle of three neighbours, counter-clockwise, and the box about it.
typedef struct nsvcd__ear {
  nsvcd__d2 at[3];
  nsvcd__corner_box box;
} nsvcd__ear;

// Is a place within an ear, and not at one of its corners?
static int nsvcd__ear_holds(const nsvcd__ear *ear, nsvcd__d2 p) {
  for (size_t k = 0; k < 3; k++) {
    if (nsvcd__d2_cross(ear->at[k], ear->at[(k + 1) % 3], p) < 0) return 0;
  }
  if (nsvcd__same_place(p, ear->at[0]) || nsvcd__same_place(p, ear->at[1])) return 0;
  return !nsvcd__same_place(p, ear->at[2]);
}

// May an ear hold a corner in a box?
static int nsvcd__ear_meets(const nsvcd__ear *ear, const nsvcd__corner_box *box) {
  if (nsvcd__same_place(box->low, box->high)) return nsvcd__ear_holds(ear, box->low);
  if (ear->box.high.x < box->low.x || ear->box.high.y < box->low.y) return 0;
  if (ear->box.low.x > box->high.x || ear->box.low.y > box->high.y) return 0;
  for (size_t k = 0; k < 3; k++) {
    // All of the box is to the right of a side: its farthest corner to the left tells.
    const nsvcd__d2 a = ear->at[k];
    const nsvcd__d2 b = ear->at[(k + 1) % 3];
    const double x = b.y > a.y ? box->low.x : box->high.x;
    const nsvcd__d2 left = {x, b.x > a.x ? box->high.y : box->low.y};
    if (nsvcd__d2_cross(a, b, left) < 0) return 0;
  }
  return 1;
}

// An ear is a convex corner whose triangle holds no other corner; only reflex ones need a look.
static int nsvcd__polygon_is_ear(const nsvcd__polygon *polygon, uint32_t i) {
  const nsvcd__corner *corners = polygon->corners;
  const nsvcd__d2 a = corners[corners[i].previous].at;
  const nsvcd__d2 c = corners[corners[i].next].at;
  nsvcd__ear ear = {{a, corners[i].at, c}, nsvcd__no_box()};
  if (nsvcd__d2_cross(a, ear.at[1], c) <= 0) return 0;
  for (size_t k = 0; k < 3; k++) nsvcd__box_take(&ear.box, ear.at[k]);
  for (uint32_t k = 1; k > 0;) {
    const nsvcd__corner_box *box = &polygon->boxes[k];
    const int meets = box->reflex > 0 && nsvcd__ear_meets(&ear, box);
    NSVCD__TALLY(boxes, 1);
    if (meets && k < polygon->runs) {
      k *= 2;
      continue;
    }
    const uint32_t first = NSVCD__RUN * (k - polygon->runs);
    for (uint32_t j = first; meets && j < first + NSVCD__RUN && j < polygon->count; j++) {
      const nsvcd__corner *p = &corners[polygon->order[j]];
      if (p->reflex && nsvcd__ear_holds(&ear, p->at)) return 0;
    }
    // to the next box that is not within this one; 0: there is none
    while (k % 2) k /= 2;
    k += k > 0;
  }
  return 1;
}

// polygon: its corners, 3 or more, with their vertices set. triangles: (count - 2, 3).
static void nsvcd__polygon_triangulate(nsvcd__polygon *polygon, const float *positions,
                                       uint32_t *triangles) {
  // A ring of the corners, and a queue of all: each may be an ear.
  nsvcd__corner *corners = polygon->corners;
  const uint32_t count = polygon->count;
  polygon->queue_first = 0;
  polygon->queue_length = 0;
  for (uint32_t i = 0; i < count; i++) {
    corners[i].previous = (i + count - 1) % count;
    corners[i].next = (i + 1) % count;
    corners[i].queued = 0;
    corners[i].reflex = 0;
  }
  if (count > 3) {
    nsvcd__polygon_project(polygon, positions);
    nsvcd__polygon_box(polygon);
    for (uint32_t i = 0; i < count; i++) nsvcd__polygon_update(polygon, i);
  }

  // some corner of what is left
  uint32_t at = 0;
  for (uint32_t left = count; left > 3;) {
    // An empty queue means that no corner is an ear: not a simple polygon. Cut any corner off and
    // go on.
    const int stuck = polygon->queue_length == 0;
    const uint32_t i = stuck ? at : polygon->queue[polygon->queue_first];
    nsvcd__corner *c = &corners[i];
    if (!stuck) {
      polygon->queue_first = (polygon->queue_first + 1) % count;
      polygon->queue_length--;
      c->queued = 0;
    }
    if (!stuck && !nsvcd__polygon_is_ear(polygon, i)) continue;
    triangles[0] = corners[c->previous].vertex;
    triangles[1] = c->vertex;
    triangles[2] = corners[c->next].vertex;
    triangles += 3;
    left--;
    corners[c->previous].next = c->next;
    corners[c->next].previous = c->previous;
    nsvcd__polygon_set_reflex(polygon, i, 0);
    nsvcd__polygon_update(polygon, c->previous);
    nsvcd__polygon_update(polygon, c->next);
    at = c->next;
  }
  triangles[0] = corners[at].vertex;
  triangles[1] = corners[corners[at].next].vertex;
  triangles[2] = corners[corners[at].previous].vertex;
}
#endif  // NSVCD_NO_OBJ

// ---------------------------------------------------------------------------------------- mesh/obj
// In: the text of a Wavefront OBJ file (version 3.0). Out: nsvcd_mesh. Statements v and f count,
// all else is skipped.
//
// Three passes over the text: count, vertices, faces. A face may refer to any vertex of the file by
// its number, also to a later one; negative numbers count back from the last vertex so far. Locale
// plays no part. Keywords that are skipped are letters, and digits behind two of them: curv2 is
// one, f1 is a mistake.

#ifndef NSVCD_NO_OBJ
typedef struct nsvcd__obj {
  const char *at, *end;
  size_t line;  // of `at`, from 1; 0: before the first
  // v statements so far
  uint32_t vertices;
  // so far, from f statements
  uint32_t triangles;
  // of a face
  uint32_t max_corners;
} nsvcd__obj;

// Length of the line's end at p; 0: there is none.
static size_t nsvcd__obj_newline(const char *p, const char *end) {
  if (p == end || (*p != '\n' && *p != '\r')) return 0;
  return end - p >= 2 && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
}
// Length of the blank at p: a backslash before the line's end continues the statement on the next
// line.
static inline size_t nsvcd__obj_blank(const char *p, const char *end) {
  if (p == end) return 0;
  if (*p == ' ' || *p == '\t' || *p == '\v' || *p == '\f') return 1;
  if (*p != '\\') return 0;
  const size_t newline = nsvcd__obj_newline(p + 1, end);
  return newline > 0 ? 1 + newline : 0;
}
static int nsvcd__obj_is_digit(const nsvcd__obj *obj) {
  return obj->at < obj->end && *obj->at >= '0' && *obj->at <= '9';
}
static int nsvcd__obj_accept(nsvcd__obj *obj, char c) {
  const int is_there = obj->at < obj->end && *obj->at == c;
  if (is_there) obj->at++;
  return is_there;
}
static int nsvcd__obj_line_ends(const nsvcd__obj *obj) {
  return obj->at == obj->end || *obj->at == '\n' || *obj->at == '\r';
}
// Reads digits; 0 where there is none. What is too large for any use stays too large.
static int nsvcd__obj_integer(nsvcd__obj *obj, int64_t *number) {
  const char *start = obj->at;
  for (*number = 0; nsvcd__obj_is_digit(obj); obj->at++) {
    if (*number < 1000000000000000) *number = 10 * *number + (*obj->at - '0');
  }
  return obj->at > start;
}
static int nsvcd__obj_token_ends(const nsvcd__obj *obj) {
  if (nsvcd__obj_line_ends(obj)) return 1;
  return nsvcd__obj_blank(obj->at, obj->end) > 0;
}
static inline void nsvcd__obj_skip_token(nsvcd__obj *obj) {
  for (; !nsvcd__obj_token_ends(obj); obj->at++) {
    // what can be nothing else, quickly
    while (obj->at + 1 < obj->end && (unsigned char)obj->at[1] > ' ' && obj->at[1] != '\\')
      obj->at++;
  }
}

// Skips blanks; 0 where the statement ends instead.
static int nsvcd__obj_has_token(nsvcd__obj *obj) {
  size_t blank = nsvcd__obj_blank(obj->at, obj->end);
  while (blank > 0) {
    obj->line += blank > 1;
    obj->at += blank;
    blank = nsvcd__obj_blank(obj->at, obj->end);
  }
  return !nsvcd__obj_line_ends(obj) && *obj->at != '#';
}

// To the next statement, past what is left of this one. Token by token, as all passes read it: what
// one takes for a comment, which nothing continues, all do. Returns its keyword: v, f, a hash for
// any other, ? for what is none, or 0 at the end of the text.
static int nsvcd__obj_next(nsvcd__obj *obj) {
  if (obj->line > 0) {
    while (nsvcd__obj_has_token(obj)) nsvcd__obj_skip_token(obj);
    while (!nsvcd__obj_line_ends(obj)) obj->at++;
    obj->at += nsvcd__obj_newline(obj->at, obj->end);
  }
  obj->line++;
  if (!nsvcd__obj_has_token(obj)) return obj->at == obj->end ? 0 : '#';
  const char *start = obj->at;
  nsvcd__obj_skip_token(obj);
  if (obj->at - start == 1 && (*start == 'v' || *start == 'f')) return *start;
  for (const char *p = start; p < obj->at; p++) {
    const int letter = (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || *p == '_';
    const int digit = *p >= '0' && *p <= '9';
    if (!letter && !(digit && p - start >= 2)) return '?';
  }
  return '#';
}

// value = mantissa * 10^exponent, exponent in -400..400. Powers up to 10^22 are exact: one rounding
// in the usual case.
static double nsvcd__obj_scale(uint64_t mantissa, int exponent) {
  static const double power[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  double value = (double)mantissa;
  for (; exponent > 22; exponent -= 22) value *= power[22];
  for (; exponent < -22; exponent += 22) value /= power[22];
  return exponent < 0 ? value / power[-exponent] : value * power[exponent];
}

// Accepts a sign; returns 1 if it is a minus.
static int nsvcd__obj_minus(nsvcd__obj *obj) {
  const int minus = nsvcd__obj_accept(obj, '-');
  if (!minus) nsvcd__obj_accept(obj, '+');
  return minus;
}

// A decimal number, as a double: within 2^-52 of it, or a few of these where its exponent is beyond
// +-22. Rounded to float it is the nearest, unless two floats are as near. NUMBER if float cannot
// hold it.
static nsvcd_result nsvcd__obj_number(nsvcd__obj *obj, double *value) {
  // FLT_MAX
  const double greatest = 3.4028234663852886e38;
  const int negative = nsvcd__obj_minus(obj);
  // nan, inf
  if (obj->at < obj->end && strchr("nNiI", *obj->at) && *obj->at) return NSVCD_ERROR_NUMBER;
  // digits and a point: mantissa * 10^exponent
  uint64_t mantissa = 0;
  int64_t exponent = 0;
  int digits = 0;
  for (int point = 0;; obj->at++) {
    if (!point && nsvcd__obj_accept(obj, '.')) point = 1;
    if (!nsvcd__obj_is_digit(obj)) break;
    digits = 1;
    // 19 digits are kept, the rest only moves the point
    const int fits = mantissa < 1000000000000000000u;
    if (fits) mantissa = 10 * mantissa + (uint64_t)(*obj->at - '0');
    exponent += !fits - point;
  }
  if (!digits) return NSVCD_ERROR_SYNTAX;
  if (nsvcd__obj_accept(obj, 'e') || nsvcd__obj_accept(obj, 'E')) {
    const int minus = nsvcd__obj_minus(obj);
    int64_t written;
    if (!nsvcd__obj_integer(obj, &written)) return NSVCD_ERROR_SYNTAX;
    exponent += minus ? -written : written;
  }
  if (!nsvcd__obj_token_ends(obj)) return NSVCD_ERROR_SYNTAX;
  if (mantissa == 0) exponent = 0;
  if (exponent > 400) return NSVCD_ERROR_NUMBER;
  const int power = exponent < -400 ? -400 : (int)exponent;
  const double magnitude = nsvcd__obj_scale(mantissa, power);
  if (magnitude > greatest) return NSVCD_ERROR_NUMBER;
  *value = negative ? -magnitude : magnitude;
  return NSVCD_OK;
}

// One corner: v, v/vt, v//vn or v/vt/vn. The numbers after a slash are not used, nor checked
// against a range. vertex_count: of the file.
static nsvcd_result nsvcd__obj_corner(nsvcd__obj *obj, uint32_t vertex_count,
                                      uint32_t *vertex) {
  const int negative = nsvcd__obj_accept(obj, '-');
  const uint32_t most = negative ? obj->vertices : vertex_count;
  int64_t number;
  int64_t unused;
  if (!nsvcd__obj_integer(obj, &number)) return NSVCD_ERROR_SYNTAX;
  for (int i = 0; i < 2 && nsvcd__obj_accept(obj, '/'); i++) {
    // v//vn
    if (i == 0 && obj->at < obj->end && *obj->at == '/') continue;
    nsvcd__obj_accept(obj, '-');
    if (!nsvcd__obj_integer(obj, &unused)) return NSVCD_ERROR_SYNTAX;
  }
  if (!nsvcd__obj_token_ends(obj)) return NSVCD_ERROR_SYNTAX;
  if (number == 0 || number > (int64_t)most) return NSVCD_ERROR_INDEX;
  *vertex = (uint32_t)(negative ? (int64_t)most - number : number - 1);
  return NSVCD_OK;
}

static void nsvcd__obj_begin(nsvcd__obj *obj, const char *text, size_t size) {
  memset(obj, 0, sizeof *obj);
  obj->at = text;
  obj->end = text + size;
  // UTF-8 byte order mark
  if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) obj->at += 3;
}

// First pass: counts vertices and triangles.
static nsvcd_result nsvcd__obj_count(nsvcd__obj *obj) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword == '?') return NSVCD_ERROR_SYNTAX;
    if (keyword == 'v' && obj->vertices++ == NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
    if (keyword != 'f') continue;
    size_t corners = 0;
    for (; nsvcd__obj_has_token(obj); nsvcd__obj_skip_token(obj)) corners++;
    if (corners < 3) return NSVCD_ERROR_SYNTAX;
    if (corners - 2 > NSVCD__MAX_COUNT - obj->triangles) return NSVCD_ERROR_TOO_LARGE;
    obj->triangles += (uint32_t)(corners - 2);
    if (corners > obj->max_corners) obj->max_corners = (uint32_t)corners;
  }
  return NSVCD_OK;
}

// Second pass: positions (vertices, 3), of v x y z, then up to five more: a weight, a colour. These
// are skipped, but must be numbers.
static nsvcd_result nsvcd__obj_vertices(nsvcd__obj *obj, float *positions) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword != 'v') continue;
    int count = 0;
    for (; nsvcd__obj_has_token(obj); count++) {
      double value;
      const nsvcd_result result = nsvcd__obj_number(obj, &value);
      if (result) return result;
      if (count == 8) return NSVCD_ERROR_SYNTAX;
      if (count >= 3) continue;
      if (fabs(value) > (double)NSVCD_MAX_COORDINATE) return NSVCD_ERROR_NUMBER;
      *positions++ = (float)value;
    }
    if (count < 3) return NSVCD_ERROR_SYNTAX;
  }
  return NSVCD_OK;
}

// Third pass: the mesh's indices. polygon: with room for any face.
static nsvcd_result nsvcd__obj_faces(nsvcd__obj *obj, const nsvcd_mesh *mesh,
                                     nsvcd__polygon *polygon) {
  uint32_t *triangles = mesh->indices;
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    obj->vertices += keyword == 'v';
    if (keyword != 'f') continue;
    polygon->count = 0;
    while (nsvcd__obj_has_token(obj)) {
      uint32_t *vertex = &polygon->corners[polygon->count++].vertex;
      const nsvcd_result result = nsvcd__obj_corner(obj, (uint32_t)mesh->vertex_count, vertex);
      if (result) return result;
    }
    nsvcd__polygon_triangulate(polygon, mesh->positions, triangles);
    triangles += 3 * (size_t)(polygon->count - 2);
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  if (error_line) *error_line = 0;
  if (!mesh || !text) return NSVCD_ERROR_ARGUMENT;
  nsvcd_mesh parsed;
  nsvcd__obj obj;
  nsvcd__polygon polygon;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  memset(&parsed, 0, sizeof parsed);
  nsvcd__obj_begin(&obj, text, size);
  nsvcd_result result = nsvcd__obj_count(&obj);
  if (!result) {
    // what follows is not tied to a line
    obj.line = 0;
    if (obj.triangles == 0) {
      result = NSVCD_ERROR_EMPTY;
    } else if (!nsvcd__mesh_alloc(&parsed, obj.vertices, obj.triangles, allocator) ||
               !nsvcd__polygon_alloc(&polygon, obj.max_corners, &arena)) {
      result = NSVCD_ERROR_MEMORY;
    }
  }
  if (!result) {
    nsvcd__obj_begin(&obj, text, size);
    result = nsvcd__obj_vertices(&obj, parsed.positions);
  }
  if (!result) {
    nsvcd__obj_begin(&obj, text, size);
    result = nsvcd__obj_faces(&obj, &parsed, &polygon);
  }
  nsvcd__arena_free(&arena);
  if (result) {
    if (error_line) *error_line = obj.line;
    nsvcd_mesh_free(&parsed, allocator);
    return result;
  }
  *mesh = parsed;
  return NSVCD_OK;
}

#ifndef NSVCD_NO_STDIO
// What a file holds; in the arena.
static nsvcd_result nsvcd__read_file(const char *path, nsvcd__arena *arena, char **text,
                                     size_t *size) {
  FILE *file = fopen(path, "rb");
  if (!file) return NSVCD_ERROR_IO;
  // No fseek, so that pipes work and a directory is an error.
  size_t capacity = 32768;
  *text = NULL;
  *size = 0;
  do {
    capacity = capacity <= SIZE_MAX / 2 ? 2 * capacity : SIZE_MAX;
    *text = (char *)nsvcd__arena_grow(arena, *text, *size, capacity, 1);
    if (*text) *size += fread(*text + *size, 1, capacity - *size, file);
  } while (*text && *size == capacity);
  nsvcd_result result = *text ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  if (*text && ferror(file)) result = NSVCD_ERROR_IO;
  fclose(file);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  char *text;
  size_t size;
  if (error_line) *error_line = 0;
  if (!path || !mesh) return NSVCD_ERROR_ARGUMENT;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  nsvcd_result result = nsvcd__read_file(path, &arena, &text, &size);
  if (!result) result = nsvcd_obj_parse(text, size, allocator, mesh, error_line);
  nsvcd__arena_free(&arena);
  return result;
}
#endif  // NSVCD_NO_STDIO
#endif  // NSVCD_NO_OBJ

// ---------------------------------------------------------------------------------------- mesh/stl
// In: an STL file, binary or text. Out: nsvcd_mesh.
//
// Binary is what has the size that its count of triangles says, or does not begin with "solid". Of
// text only the words vertex and endloop count: three vertices a loop.

#ifndef NSVCD_NO_OBJ
#define NSVCD__STL_HEADER 84  // bytes, the count of triangles included
#define NSVCD__STL_FACET 50

static uint32_t nsvcd__stl_word(const unsigned char *p) {
  return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

// Three floats of a file that is binary.
static nsvcd_result nsvcd__stl_corner(const unsigned char *at, float *out) {
  for (size_t k = 0; k < 3; k++) {
    const uint32_t bits = nsvcd__stl_word(at + 4 * k);
    memcpy(&out[k], &bits, sizeof bits);
    if (!nsvcd__is_finite(out[k]) || fabsf(out[k]) > NSVCD_MAX_COORDINATE)
      return NSVCD_ERROR_NUMBER;
  }
  return NSVCD_OK;
}

// Goes to the next token, past the ends of lines; 0 at the end of the text.
static int nsvcd__stl_token(nsvcd__obj *text) {
  for (;;) {
    const size_t newline = nsvcd__obj_newline(text->at, text->end);
    const size_t skipped = newline ? newline : nsvcd__obj_blank(text->at, text->end);
    if (!skipped) return text->at < text->end;
    text->line += newline > 0;
    text->at += skipped;
  }
}

// Is the token this word, in small letters or capitals? Then it is passed.
static int nsvcd__stl_accept(nsvcd__obj *text, const char *word) {
  const char *p = text->at;
  for (; *word; word++, p++) {
    if (p == text->end || (*p | 32) != *word) return 0;
  }
  nsvcd__obj rest = *text;
  rest.at = p;
  if (!nsvcd__obj_token_ends(&rest)) return 0;
  text->at = p;
  return 1;
}

// Reads corners (count, 3) of a text, or, where that is NULL, only counts them.
static nsvcd_result nsvcd__stl_text(nsvcd__obj *text, float *corners, size_t *count) {
  size_t in_loop = 0;
  *count = 0;
  while (nsvcd__stl_token(text)) {
    if (nsvcd__stl_accept(text, "solid") || nsvcd__stl_accept(text, "endsolid")) {
      // a name follows
      while (!nsvcd__obj_line_ends(text)) text->at++;
    } else if (nsvcd__stl_accept(text, "endloop")) {
      if (in_loop != 3) return NSVCD_ERROR_SYNTAX;
      in_loop = 0;
    } else if (nsvcd__stl_accept(text, "vertex")) {
      for (size_t k = 0; k < 3 && corners; k++) {
        double value;
        if (!nsvcd__stl_token(text)) return NSVCD_ERROR_SYNTAX;
        const nsvcd_result result = nsvcd__obj_number(text, &value);
        if (result) return result;
        if (fabs(value) > (double)NSVCD_MAX_COORDINATE) return NSVCD_ERROR_NUMBER;
        corners[3 * *count + k] = (float)value;
      }
      in_loop++;
      ++*count;
    } else {
      nsvcd__obj_skip_token(text);
    }
  }
  return in_loop == 0 ? NSVCD_OK : NSVCD_ERROR_SYNTAX;
}

// Makes one vertex of corners at the same place: corners (3 triangles, 3) become positions, and
// their numbers indices. table: (slots), a power of two, of numbers + 1; zeros.
static void nsvcd__stl_weld(nsvcd_mesh *mesh, uint32_t *table, size_t slots) {
  const size_t corners = mesh->vertex_count;
  float *positions = mesh->positions;
  mesh->vertex_count = 0;
  for (size_t i = 0; i < corners; i++) {
    uint32_t bits[3];
    float corner[3];
    for (size_t k = 0; k < 3; k++) corner[k] = positions[3 * i + k] + 0.0f;  // -0 is 0
    memcpy(bits, corner, sizeof bits);
    uint64_t hash = bits[0];
    hash = (hash * UINT64_C(0x9e3779b97f4a7c15)) ^ bits[1];
    hash = (hash * UINT64_C(0x9e3779b97f4a7c15)) ^ bits[2];
    hash *= UINT64_C(0x9e3779b97f4a7c15);
    size_t slot = (size_t)(hash >> 32) & (slots - 1);
    while (table[slot] &&
           memcmp(positions + 3 * (size_t)(table[slot] - 1), corner, sizeof corner) != 0)
      slot = (slot + 1) & (slots - 1);
    if (!table[slot]) {
      memcpy(positions + 3 * mesh->vertex_count, corner, sizeof corner);
      table[slot] = (uint32_t)++mesh->vertex_count;
    }
    mesh->indices[i] = table[slot] - 1;
  }
}

NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  const unsigned char *bytes = (const unsigned char *)data;
  if (error_line) *error_line = 0;
  if (!mesh || !data) return NSVCD_ERROR_ARGUMENT;
  nsvcd__obj text;
  nsvcd_result result = NSVCD_OK;
  size_t corners = 0;
  nsvcd__obj_begin(&text, (const char *)data, size);
  const int is_solid = nsvcd__stl_token(&text) && nsvcd__stl_accept(&text, "solid");
  const uint64_t told = size < NSVCD__STL_HEADER ? 0 : nsvcd__stl_word(bytes + 80);
  const uint64_t needed = NSVCD__STL_HEADER + NSVCD__STL_FACET * told;
  const int is_binary = size == needed || !is_solid;
  if (is_binary && size < needed) return NSVCD_ERROR_SYNTAX;
  nsvcd__obj_begin(&text, (const char *)data, size);
  text.line = 1;
  if (is_binary) {
    if (told > NSVCD__MAX_COUNT / 3) return NSVCD_ERROR_TOO_LARGE;
    corners = 3 * (size_t)told;
  } else {
    result = nsvcd__stl_text(&text, NULL, &corners);
    if (!result && corners > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  }
  if (!result && corners == 0) return NSVCD_ERROR_EMPTY;
  nsvcd_mesh out;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  memset(&out, 0, sizeof out);
  size_t slots = 16;
  while (slots < 2 * corners) slots *= 2;
  uint32_t *table = NULL;
  if (!result) {
    table = NSVCD__TAKE(&arena, uint32_t, slots);
    if (!table || !nsvcd__mesh_alloc(&out, corners, corners / 3, allocator)) {
      text.line = 0;
      result = NSVCD_ERROR_MEMORY;
    }
  }
  if (!result && !is_binary) {
    nsvcd__obj_begin(&text, (const char *)data, size);
    text.line = 1;
    result = nsvcd__stl_text(&text, out.positions, &corners);
  }
  for (size_t i = 0; i < corners && is_binary && !result; i++) {
    const size_t facet = NSVCD__STL_HEADER + NSVCD__STL_FACET * (i / 3);
    result = nsvcd__stl_corner(bytes + facet + 12 * (1 + i % 3), out.positions + 3 * i);
  }
  if (!result) nsvcd__stl_weld(&out, table, slots);
  nsvcd__arena_free(&arena);
  if (result) {
    if (error_line && !is_binary) *error_line = text.line;
    nsvcd_mesh_free(&out, allocator);
    return result;
  }
  *mesh = out;
  return NSVCD_OK;
}

#ifndef NSVCD_NO_STDIO
NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  char *data;
  size_t size;
  if (error_line) *error_line = 0;
  if (!path || !mesh) return NSVCD_ERROR_ARGUMENT;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  nsvcd_result result = nsvcd__read_file(path, &arena, &data, &size);
  if (!result) result = nsvcd_stl_parse(data, size, allocator, mesh, error_line);
  nsvcd__arena_free(&arena);
  return result;
}
#endif  // NSVCD_NO_STDIO
#endif  // NSVCD_NO_OBJ

// ======================================================================== patches: a mesh in parts

// --------------------------------------------------------------------------------- patches/samples
// In: a checked mesh. Out: S samples, which are oriented points of the surface; and what its N
// patches will be: samples grouped by patch, and one ball for each patch. Everything on this floor
// is deterministic and, up to rounding, scales and moves with the mesh.

#ifndef NSVCD_NO_ENCODER
// on average
#define NSVCD__SAMPLES_PER_PATCH 32
#define NSVCD__NO_SAMPLE 0xffffffffu
#define NSVCD__LLOYD_STEPS 3
// of each centre, for the search of the nearest centre
#define NSVCD__NEIGHBOURS 16
// longest edge of a piece, in mean sample radii
#define NSVCD__PIECE_SIZE 0.25
// bounds the number of pieces that halving adds
#define NSVCD__PIECES_PER_SAMPLE 64

// Sums over a patch, in double, rounded once at the end.
typedef struct nsvcd__patch_sum {
  // of the positions of samples, or of area vectors
  nsvcd__d3 vector;
  double weight;  // number of samples
  // greatest squared distance from the centre
  double squared_reach;
} nsvcd__patch_sum;

typedef struct nsvcd__patches {
  size_t count;         // N
  size_t sample_count;  // S
  // pieces of surface that the balls were fitted to
  size_t piece_count;
  // (N) metres: the mean of the patch's samples
  nsvcd__f3 *centres;
  // (N) the ball about the centre with this radius contains every piece of the patch
  float *radii;
  // (N) the same for the patch's samples
  float *sample_radii;
  // (N) area times normal, summed over the patch; over all patches it is that of the mesh
  nsvcd__f3 *area_vectors;
  // (N + 1) patch i has the samples offsets[i] .. offsets[i + 1] - 1
  uint32_t *offsets;
  nsvcd__f3 *samples;  // (S) metres
  nsvcd__f3 *normals;  // (S) unit

  // Working memory.
  nsvcd__patch_sum *sums;  // (N)
  // (S) the samples in the order in which they were drawn
  nsvcd__f3 *drawn;
  nsvcd__f3 *drawn_normals;
  // (S) the patch of each sample drawn
  uint16_t *owners;
  // (S) squared, to the nearest centre so far; it lies where `samples` will be
  float *squares;
  // (S) lists of the samples of each centre, while centres are added; it lies there too
  uint32_t *next_sample;
  uint32_t *first_sample;  // (N)
  // (N) of the samples of the centre, and its squared distance
  uint32_t *farthest_sample;
  float *squared_reach;
  // (N, NEIGHBOURS) the other centres nearest to each, in order of distance
  uint32_t *neighbours;
  // (N, NEIGHBOURS) a quarter of their squared distance
  float *quarter_squares;
} nsvcd__patches;

// ---- samples

// Differences of floats are as good as exact in double.
typedef struct nsvcd__triangle {
  nsvcd__d3 at[3];
} nsvcd__triangle;

static nsvcd__triangle nsvcd__triangle_of(const nsvcd_mesh *mesh, size_t t) {
  const float *from = mesh->positions;
  const uint32_t *i = mesh->indices + 3 * t;
  const nsvcd__triangle out = {
      {nsvcd__d3_row(from, i[0]), nsvcd__d3_row(from, i[1]), nsvcd__d3_row(from, i[2])}};
  return out;
}

// Area times unit normal.
static nsvcd__d3 nsvcd__area_vector(const nsvcd__triangle *t) {
  const nsvcd__d3 u = nsvcd__d3_sub(t->at[1], t->at[0]);
  const nsvcd__d3 v = nsvcd__d3_sub(t->at[2], t->at[0]);
  return nsvcd__d3_scale(nsvcd__d3_cross(u, v), 0.5);
}

static double nsvcd__triangle_area(const nsvcd__triangle *t) {
  return nsvcd__d3_length(nsvcd__area_vector(t));
}

static double nsvcd__mesh_area(const nsvcd_mesh *mesh) {
  double area = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
    area += nsvcd__triangle_area(&triangle);
  }
  return area;
}

// Draws samples (count) and their unit normals (count), stratified by area: sample k lies in the
// triangle where the area summed in triangle order passes (k + 1/2) / count of the total, where the
// R2 sequence says (Roberts 2018: multiples of 1/g and 1/g^2, g^3 = g + 1). Where there is no area,
// triangles count alike, and normals are 0.
static void nsvcd__sample_surface(const nsvcd_mesh *mesh, size_t count, nsvcd__f3 *samples,
                                  nsvcd__f3 *normals) {
  const double all = nsvcd__mesh_area(mesh);
  const double total = all > 0 ? all : (double)mesh->triangle_count;
  nsvcd__triangle triangle;
  double area = 0;
  // the area up to and including the triangle
  double passed = 0;
  size_t next = 0;
  for (size_t k = 0; k < count; k++) {
    const double target = total * (((double)k + 0.5) / (double)count);
    // never stops at a triangle without area
    while (passed <= target && next < mesh->triangle_count) {
      triangle = nsvcd__triangle_of(mesh, next++);
      area = nsvcd__triangle_area(&triangle);
      passed += all > 0 ? area : 1;
    }
    double u = (double)((uint32_t)k * 3242174889u + 0x80000000u) / 4294967296.0;
    double v = (double)((uint32_t)k * 2447445414u + 0x80000000u) / 4294967296.0;
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const nsvcd__d3 ab = nsvcd__d3_sub(triangle.at[1], triangle.at[0]);
    const nsvcd__d3 ac = nsvcd__d3_sub(triangle.at[2], triangle.at[0]);
    const nsvcd__d3 along = nsvcd__d3_fma(u, ab, triangle.at[0]);
    samples[k] = nsvcd__d3_narrow(nsvcd__d3_fma(v, ac, along));
    normals[k] = nsvcd__f3_of(0, 0, 0);
    if (area > 0)
      normals[k] = nsvcd__d3_narrow(nsvcd__d3_over(nsvcd__area_vector(&triangle), area));
  }
}

// Room for so many patches and samples. 0 without memory.
static int nsvcd__patches_alloc(nsvcd__patches *p, size_t count, size_t samples,
                                nsvcd__arena *arena) {
  const size_t links = NSVCD__NEIGHBOURS * count;
  memset(p, 0, sizeof *p);
  p->count = count;
  p->sample_count = samples;
  p->sums = NSVCD__TAKE(arena, nsvcd__patch_sum, count);
  p->centres = NSVCD__TAKE(arena, nsvcd__f3, count);
  p->radii = NSVCD__TAKE(arena, float, count);
  p->sample_radii = NSVCD__TAKE(arena, float, count);
  p->area_vectors = NSVCD__TAKE(arena, nsvcd__f3, count);
  p->drawn = NSVCD__TAKE(arena, nsvcd__f3, samples);
  p->drawn_normals = NSVCD__TAKE(arena, nsvcd__f3, samples);
  p->samples = NSVCD__TAKE(arena, nsvcd__f3, samples);
  p->normals = NSVCD__TAKE(arena, nsvcd__f3, samples);
  p->quarter_squares = NSVCD__TAKE(arena, float, links);
  p->squared_reach = NSVCD__TAKE(arena, float, count);
  p->first_sample = NSVCD__TAKE(arena, uint32_t, count);
  p->farthest_sample = NSVCD__TAKE(arena, uint32_t, count);
  p->neighbours = NSVCD__TAKE(arena, uint32_t, links);
  p->offsets = NSVCD__TAKE(arena, uint32_t, count + 1);
  p->owners = NSVCD__TAKE(arena, uint16_t, samples);
  if (arena->failed) return 0;
  p->squares = (float *)(void *)p->samples;
  p->next_sample = (uint32_t *)(void *)(p->squares + samples);
  return 1;
}
#endif  // NSVCD_NO_ENCODER

// -------------------------------------------------------------------------------- patches/clusters
// In: samples. Out: centres, and the samples of each.

#ifndef NSVCD_NO_ENCODER
// The squared distance of a point from a centre.
static float nsvcd__to_centre2(const nsvcd__patches *p, uint32_t centre, nsvcd__f3 at) {
  const nsvcd__f3 offset = nsvcd__f3_sub(p->centres[centre], at);
  return nsvcd__f3_dot(offset, offset);
}

// Lists the nearest other centres of each centre; a short list ends in infinities.
static void nsvcd__link_centres(nsvcd__patches *p) {
  const size_t last = NSVCD__NEIGHBOURS - 1;
  for (uint32_t i = 0; i < p->count; i++) {
    uint32_t *neighbours = p->neighbours + (size_t)i * NSVCD__NEIGHBOURS;
    float *quarters = p->quarter_squares + (size_t)i * NSVCD__NEIGHBOURS;
    for (size_t k = 0; k <= last; k++) {
      neighbours[k] = i;
      quarters[k] = HUGE_VALF;
    }
    for (uint32_t j = 0; j < p->count; j++) {
      const float quarter = 0.25f * nsvcd__to_centre2(p, j, p->centres[i]);
      if (j == i || quarter >= quarters[last]) continue;
      size_t k = last;
      for (; k > 0 && quarters[k - 1] > quarter; k--) {
        quarters[k] = quarters[k - 1];
        neighbours[k] = neighbours[k - 1];
      }
      quarters[k] = quarter;
      neighbours[k] = j;
    }
  }
}

// The centre nearest to a point, of equals the first, found from a guess. A centre twice as far
// from the guess as the point is cannot be nearer to the point (triangle inequality). So the
// guess's neighbours usually decide; where they do not, they give a better guess, or all decide.
static uint32_t nsvcd__nearest_centre(const nsvcd__patches *p, uint32_t guess, nsvcd__f3 at) {
  uint32_t best = guess;
  float least = nsvcd__to_centre2(p, guess, at);
  for (int all = 0;;) {
    const uint32_t *neighbours = p->neighbours + (size_t)guess * NSVCD__NEIGHBOURS;
    const float *quarters = p->quarter_squares + (size_t)guess * NSVCD__NEIGHBOURS;
    const size_t most = all ? p->count : NSVCD__NEIGHBOURS;
    const float own = least;
    size_t k = 0;
    for (; k < most && (all || quarters[k] <= own); k++) {
      const uint32_t i = all ? (uint32_t)k : neighbours[k];
      const float square = nsvcd__to_centre2(p, i, at);
      if (square > least || (square >= least && i >= best)) continue;
      best = i;
      least = square;
    }
    if (all || k < most) return best;
    all = best == guess;
    guess = best;
  }
}

static void nsvcd__forget_samples(nsvcd__patches *p, uint32_t centre) {
  p->first_sample[centre] = NSVCD__NO_SAMPLE;
  p->squared_reach[centre] = -1;
}

// square: of its distance from the owner.
static inline void nsvcd__give_sample(nsvcd__patches *p, uint32_t s, uint32_t owner,
                                      float square) {
  p->owners[s] = (uint16_t)owner;
  p->squares[s] = square;
  p->next_sample[s] = p->first_sample[owner];
  p->first_sample[owner] = s;
  if (square > p->squared_reach[owner]) {
    p->squared_reach[owner] = square;
    p->farthest_sample[owner] = s;
  }
}

// Farthest point sampling (Gonzalez 1985). The first centre is the sample farthest from the mean of
// all. Ends early once every sample is at a centre.
static void nsvcd__farthest_points(nsvcd__patches *p) {
  nsvcd__d3 sum = nsvcd__d3_of(0, 0, 0);
  for (size_t s = 0; s < p->sample_count; s++)
    sum = nsvcd__d3_add(sum, nsvcd__d3_widen(p->drawn[s]));
  p->centres[0] = nsvcd__d3_narrow(nsvcd__d3_over(sum, (double)p->sample_count));
  for (int pass = 0; pass < 2; pass++) {
    if (pass == 1) p->centres[0] = p->drawn[p->farthest_sample[0]];
    nsvcd__forget_samples(p, 0);
    for (uint32_t s = 0; s < p->sample_count; s++)
      nsvcd__give_sample(p, s, 0, nsvcd__to_centre2(p, 0, p->drawn[s]));
  }

  uint32_t count = 1;
  for (; count < p->count; count++) {
    uint32_t farthest = 0;
    for (uint32_t i = 1; i < count; i++)
      farthest = p->squared_reach[i] > p->squared_reach[farthest] ? i : farthest;
    if (!(p->squared_reach[farthest] > 0)) break;
    p->centres[count] = p->drawn[p->farthest_sample[farthest]];
    nsvcd__forget_samples(p, count);
    for (uint32_t owner = 0; owner < count; owner++) {
      // An owner more than twice as far away as its farthest sample loses none (triangle
      // inequality): most are passed over.
      const float square = nsvcd__to_centre2(p, owner, p->centres[count]);
      if (0.25f * square > p->squared_reach[owner]) continue;
      uint32_t s = p->first_sample[owner];
      nsvcd__forget_samples(p, owner);
      while (s != NSVCD__NO_SAMPLE) {
        const uint32_t next = p->next_sample[s];
        const float old = p->squares[s];
        const float fresh = nsvcd__to_centre2(p, count, p->drawn[s]);
        const int nearer = fresh < old;
        nsvcd__give_sample(p, s, nearer ? count : owner, nearer ? fresh : old);
        s = next;
      }
    }
  }
  p->count = count;
}

// Moves every centre to the mean of its samples. A centre without samples is dropped, and the
// others close the gap.
static void nsvcd__move_centres(nsvcd__patches *p) {
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t s = 0; s < p->sample_count; s++) {
    nsvcd__patch_sum *sum = &p->sums[p->owners[s]];
    sum->vector = nsvcd__d3_add(sum->vector, nsvcd__d3_widen(p->drawn[s]));
    sum->weight += 1;
  }

  uint32_t kept = 0;
  for (size_t i = 0; i < p->count; i++) {
    const nsvcd__patch_sum *sum = &p->sums[i];
    // for now: the new number of patch i
    p->offsets[i] = kept;
    if (!(sum->weight > 0)) continue;
    const nsvcd__d3 mean = nsvcd__d3_over(sum->vector, sum->weight);
    p->centres[kept++] = nsvcd__d3_narrow(mean);
  }
  for (size_t s = 0; s < p->sample_count; s++)
    p->owners[s] = (uint16_t)p->offsets[p->owners[s]];
  p->count = kept;
  nsvcd__link_centres(p);
}

// Makes a sum reach to a point.
static void nsvcd__reach_to(nsvcd__patches *p, size_t patch, nsvcd__d3 at) {
  nsvcd__patch_sum *sum = &p->sums[patch];
  const double square = nsvcd__d3_distance2(at, nsvcd__d3_widen(p->centres[patch]));
  sum->squared_reach = nsvcd__max(sum->squared_reach, square);
}

// Root, rounded up: a radius may be too large by a rounding, never too small.
static float nsvcd__radius_above(double squared) {
  return (float)(sqrt(squared) * (1 + 4e-7));
}

// Writes the samples patch by patch, in a patch in their order (counting sort), and the sample
// radii.
static void nsvcd__group_samples(nsvcd__patches *p) {
  memset(p->offsets, 0, (p->count + 1) * sizeof *p->offsets);
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t s = 0; s < p->sample_count; s++) p->offsets[p->owners[s] + 1]++;
  for (size_t i = 0; i < p->count; i++) p->offsets[i + 1] += p->offsets[i];

  for (size_t s = 0; s < p->sample_count; s++) {
    const uint32_t owner = p->owners[s];
    // afterwards each offset is the next patch's
    const size_t to = p->offsets[owner]++;
    p->samples[to] = p->drawn[s];
    p->normals[to] = p->drawn_normals[s];
    nsvcd__reach_to(p, owner, nsvcd__d3_widen(p->drawn[s]));
  }
  memmove(p->offsets + 1, p->offsets, p->count * sizeof *p->offsets);
  p->offsets[0] = 0;
  for (size_t i = 0; i < p->count; i++)
    p->sample_radii[i] = nsvcd__radius_above(p->sums[i].squared_reach);
}
#endif  // NSVCD_NO_ENCODER

// -------------------------------------------------------------------------------- patches/covering
// In: centres, their samples, and the mesh. Out: of each patch a ball; together the balls hold
// every triangle.
//
// Every triangle is halved across its longest edge until no edge exceeds `limit`. Each piece goes
// to the patch whose centre is nearest to the piece's centroid. That patch's ball grows to hold the
// piece's three corners, and so all of it.

#ifndef NSVCD_NO_ENCODER
static inline size_t nsvcd__longest_of(const double *e) {
  if (e[1] > e[0] && e[1] >= e[2]) return 1;
  return e[2] > e[0] ? 2 : 0;
}
// The squared lengths of a triangle's edges, each from a corner to the next one. Returns which is
// the longest; of equal ones the first.
static inline size_t nsvcd__edge_squares(const nsvcd__triangle *t, double *e) {
  e[0] = nsvcd__d3_distance2(t->at[0], t->at[1]);
  e[1] = nsvcd__d3_distance2(t->at[1], t->at[2]);
  e[2] = nsvcd__d3_distance2(t->at[2], t->at[0]);
  return nsvcd__longest_of(e);
}

// How many pieces a triangle makes; stops counting beyond `most`. The new edge is the median of the
// longest one (Apollonius's theorem), so lengths are enough.
static double nsvcd__count_pieces(const double *e, double limit, double most) {
  const size_t k = nsvcd__longest_of(e);
  const size_t next = k == 2 ? 0 : k + 1;
  const double ab = e[k];
  const double bc = e[next];
  const double ca = e[3 - k - next];
  if (ab <= limit * limit) return 1;
  const double median = 0.5 * (bc + ca) - 0.25 * ab;
  const double near_a[3] = {0.25 * ab, median, ca};
  const double near_b[3] = {0.25 * ab, bc, median};
  const double pieces = nsvcd__count_pieces(near_a, limit, most);
  if (pieces > most) return pieces;
  return pieces + nsvcd__count_pieces(near_b, limit, most - pieces);
}

// The limit on the edges of pieces: twice, four times ... the given one, until a mesh makes no more
// than `most` pieces. Writes how many.
static double nsvcd__raise_limit(const nsvcd_mesh *mesh, double limit, double most,
                                 double *pieces) {
  // A triangle makes at least as many pieces as its longest edge has limits: no need to begin below
  // that.
  double longest = 0;
  double e[3];
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
    const size_t k = nsvcd__edge_squares(&triangle, e);
    longest = nsvcd__max(longest, e[k]);
  }
  for (limit = nsvcd__max(limit, sqrt(longest) / most);; limit *= 2) {
    *pieces = 0;
    for (size_t t = 0; t < mesh->triangle_count && *pieces <= most; t++) {
      const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
      (void)nsvcd__edge_squares(&triangle, e);
      *pieces += nsvcd__count_pieces(e, limit, most - *pieces);
    }
    if (*pieces <= most) return limit;
  }
}

// Covers a triangle, halved as often as need be; a small one goes to the patch with the nearest
// centre. vector: its area times its normal. guess: a patch near by. Returns the patch of the last
// half: the guess for what comes next.
static uint32_t nsvcd__cover_triangle(nsvcd__patches *p, double limit, uint32_t guess,
                                      const nsvcd__triangle *t, nsvcd__d3 vector) {
  double e[3];
  const size_t k = nsvcd__edge_squares(t, e);
  const size_t next = k == 2 ? 0 : k + 1;
  const nsvcd__d3 a = t->at[k];
  const nsvcd__d3 b = t->at[next];
  const nsvcd__d3 c = t->at[3 - k - next];
  if (e[k] <= limit * limit) {
    const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(a, b), c);
    const nsvcd__f3 centroid = nsvcd__d3_narrow(nsvcd__d3_over(sum, 3));
    const uint32_t patch = nsvcd__nearest_centre(p, guess, centroid);
    p->sums[patch].vector = nsvcd__d3_add(p->sums[patch].vector, vector);
    for (size_t i = 0; i < 3; i++) nsvcd__reach_to(p, patch, t->at[i]);
    p->piece_count++;
    return patch;
  }
  const nsvcd__d3 middle = nsvcd__d3_scale(nsvcd__d3_add(a, b), 0.5);
  const nsvcd__triangle near_a = {{a, middle, c}};
  const nsvcd__triangle near_b = {{middle, b, c}};
  vector = nsvcd__d3_scale(vector, 0.5);
  guess = nsvcd__cover_triangle(p, limit, guess, &near_a, vector);
  return nsvcd__cover_triangle(p, limit, guess, &near_b, vector);
}

static void nsvcd__cover(nsvcd__patches *p, const nsvcd_mesh *mesh) {
  const double added = NSVCD__PIECES_PER_SAMPLE * (double)p->sample_count;
  const double most = (double)mesh->triangle_count + added;
  double pieces;
  // Larger pieces only make larger balls.
  double limit = 0;
  for (size_t i = 0; i < p->count; i++) limit += (double)p->sample_radii[i] / (double)p->count;
  limit *= NSVCD__PIECE_SIZE;
  // otherwise all samples of each patch coincide: nothing to go by
  limit = limit > 0 ? nsvcd__raise_limit(mesh, limit, most, &pieces) : HUGE_VAL;

  uint32_t guess = 0;
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
    const nsvcd__d3 vector = nsvcd__area_vector(&triangle);
    guess = nsvcd__cover_triangle(p, limit, guess, &triangle, vector);
  }
  for (size_t i = 0; i < p->count; i++) {
    const nsvcd__patch_sum *sum = &p->sums[i];
    // A piece goes to one patch as a whole, and so a patch's samples may lie beyond its pieces: its
    // ball holds both.
    const float radius = nsvcd__radius_above(sum->squared_reach);
    p->radii[i] = fmaxf(radius, p->sample_radii[i]);
    p->area_vectors[i] = nsvcd__d3_narrow(sum->vector);
  }
}

// ---- all of it

// Splits the surface of a checked mesh into at most `count` patches, 1..NSVCD_SMALL_PATCHES: fewer
// where samples coincide or a patch loses all of its samples. MEMORY.
static nsvcd_result nsvcd__patches_build(const nsvcd_mesh *mesh, size_t count,
                                         nsvcd__arena *arena, nsvcd__patches *p) {
  if (!nsvcd__patches_alloc(p, count, NSVCD__SAMPLES_PER_PATCH * count, arena))
    return NSVCD_ERROR_MEMORY;
  nsvcd__sample_surface(mesh, p->sample_count, p->drawn, p->drawn_normals);
  nsvcd__farthest_points(p);
  nsvcd__move_centres(p);
  for (int step = 1; step < NSVCD__LLOYD_STEPS; step++) {
    for (size_t s = 0; s < p->sample_count; s++)
      p->owners[s] = (uint16_t)nsvcd__nearest_centre(p, p->owners[s], p->drawn[s]);
    nsvcd__move_centres(p);
  }
  nsvcd__group_samples(p);
  nsvcd__cover(p, mesh);
  return NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER

// -------------------------------------------------------------------------------- patches/topology
// In: a checked mesh. Out: what is learned of it: vertices at the same place are one, triangles
// that share vertices are one component, and a component is closed or not.

#ifndef NSVCD_NO_ENCODER
// What is learned of a mesh. Vertices at the same place are one: the first of them. A component
// goes by its root, the least of its vertices.
typedef struct nsvcd__topology {
  const nsvcd_mesh *mesh;
  size_t component_count;
  // (vertices) the first vertex at the same place
  uint32_t *welded;
  // (vertices) of the union-find forest; in the end the root
  uint32_t *parents;
  // (vertices) of a root: its component is not closed
  uint8_t *open;
  // (vertices) of a root: a triangle belongs to it
  uint8_t *seen;
} nsvcd__topology;

// Finds the first vertex at each place, in a table of open addresses. 0 without memory.
static int nsvcd__weld(nsvcd__topology *topology, const nsvcd_allocator *allocator) {
  const nsvcd_mesh *mesh = topology->mesh;
  size_t slots = 16;
  while (slots / 2 < mesh->vertex_count) slots *= 2;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  // 0: none, else a vertex + 1
  uint32_t *table = NSVCD__TAKE(&arena, uint32_t, slots);
  for (uint32_t v = 0; table && v < mesh->vertex_count; v++) {
    const float *at = mesh->positions + 3 * (size_t)v;
    uint32_t hash = 0;
    for (size_t k = 0; k < 3; k++) {
      uint32_t bits;
      memcpy(&bits, at + k, sizeof bits);
      // -0 is at the same place as 0
      if (bits == 0x80000000u) bits = 0;
      hash = (hash ^ bits) * 0x9e3779b1u;
      hash ^= hash >> 15;
    }
    size_t slot = (hash * 0x85ebca6bu ^ hash >> 13) & (slots - 1);
    for (; table[slot]; slot = (slot + 1) & (slots - 1)) {
      const float *other = mesh->positions + 3 * (size_t)(table[slot] - 1);
      if (other[0] == at[0] && other[1] == at[1] && other[2] == at[2]) break;
    }
    if (!table[slot]) table[slot] = v + 1;
    topology->welded[v] = table[slot] - 1;
  }
  nsvcd__arena_free(&arena);
  return !arena.failed;
}

static void nsvcd__welded_face(const nsvcd__topology *topology, size_t t, uint32_t *face) {
  const uint32_t *corners = topology->mesh->indices + 3 * t;
  face[0] = topology->welded[corners[0]];
  face[1] = topology->welded[corners[1]];
  face[2] = topology->welded[corners[2]];
}

static uint32_t nsvcd__root(uint32_t *parents, uint32_t v) {
  while (parents[v] != v) {
    parents[v] = parents[parents[v]];
    v = parents[v];
  }
  return v;
}

// Finds the components that are not closed: those whose directed edges do not cancel. 0 without
// memory.
static int nsvcd__find_open(nsvcd__topology *topology, const nsvcd_allocator *allocator) {
  const nsvcd_mesh *mesh = topology->mesh;
  const size_t vertices = mesh->vertex_count;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  // where the edges of a vertex begin, which is the lesser of their ends; one more, while sorted
  size_t *first = NSVCD__TAKE(&arena, size_t, vertices + 2);
  // the greater end
  uint32_t *ends = NSVCD__TAKE(&arena, uint32_t, 3 * mesh->triangle_count);
  // 1: an edge leads to the greater end; -1: from it
  int8_t *signs = NSVCD__TAKE(&arena, int8_t, 3 * mesh->triangle_count);
  // sums over the edges of one vertex, by their other end; else zero
  int32_t *balances = NSVCD__TAKE(&arena, int32_t, vertices);
  // counting sort of the edges: they are counted, then placed
  for (int pass = 0; !arena.failed && pass < 2; pass++) {
    for (size_t t = 0; t < mesh->triangle_count; t++) {
      uint32_t face[3];
      nsvcd__welded_face(topology, t, face);
      // then the edges cancel among themselves
      if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
      for (size_t k = 0; k < 3; k++) {
        const uint32_t from = face[k];
        const uint32_t to = face[(k + 1) % 3];
        const uint32_t low = from < to ? from : to;
        if (pass == 0) {
          first[low + 2]++;
          continue;
        }
        // afterwards the start of the next
        const size_t place = first[low + 1]++;
        ends[place] = from < to ? to : from;
        signs[place] = from < to ? 1 : -1;
      }
    }
    for (size_t v = 0; pass == 0 && v < vertices; v++) first[v + 2] += first[v + 1];
  }
  for (size_t v = 0; !arena.failed && v < vertices; v++) {
    for (size_t e = first[v]; e < first[v + 1]; e++) balances[ends[e]] += signs[e];
    for (size_t e = first[v]; e < first[v + 1]; e++) {
      if (balances[ends[e]] != 0) topology->open[topology->parents[v]] = 1;
    }
    for (size_t e = first[v]; e < first[v + 1]; e++) balances[ends[e]] = 0;
  }
  nsvcd__arena_free(&arena);
  return !arena.failed;
}

// 0 without memory.
static int nsvcd__topology_build(const nsvcd_mesh *mesh, nsvcd__arena *arena,
                                 nsvcd__topology *topology) {
  topology->mesh = mesh;
  topology->component_count = 0;
  topology->welded = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count);
  topology->parents = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count);
  topology->open = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  topology->seen = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  if (arena->failed || !nsvcd__weld(topology, arena->allocator)) return 0;

  uint32_t *parents = topology->parents;
  uint32_t face[3];
  for (uint32_t v = 0; v < mesh->vertex_count; v++) parents[v] = v;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__welded_face(topology, t, face);
    for (size_t k = 1; k < 3; k++) {
      const uint32_t a = nsvcd__root(parents, face[0]);
      const uint32_t b = nsvcd__root(parents, face[k]);
      parents[a > b ? a : b] = a < b ? a : b;
    }
  }
  for (uint32_t v = 0; v < mesh->vertex_count; v++) parents[v] = nsvcd__root(parents, v);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__welded_face(topology, t, face);
    topology->component_count += !topology->seen[parents[face[0]]];
    topology->seen[parents[face[0]]] = 1;
  }
  return nsvcd__find_open(topology, arena->allocator);
}
#endif  // NSVCD_NO_ENCODER

// --------------------------------------------------------------------------------- patches/regions
// In: a checked mesh. Out: its triangles, welded, in one region, or in as many as it takes to have
// no more than 512 patches in each. Each region is then made into patches by itself. Where there
// are several, large triangles are halved first, until none is large beside the regions. Nothing is
// lost: halves share the corner between them, and both are kept.

#ifndef NSVCD_NO_ENCODER
// patches of a region, where there are several
#define NSVCD__REGION_PATCHES 256
// longest edge, in roots of a region's mean area
#define NSVCD__REGION_EDGE 0.5
// a cut between regions is found to the width of one
#define NSVCD__REGION_BINS 512
// bounds the triangles that halving adds
#define NSVCD__HALVES_PER_REGION 256

// Points are numbered: the vertices of the caller's mesh, then the cuts, which halving has made.
typedef struct nsvcd__regions {
  const nsvcd_mesh *mesh;
  // of all coordinates
  double greatest;
  size_t component_count;  // C
  // (vertices) 1: of its component the least vertex, which no patch has been given yet
  uint8_t *seeds;
  size_t count;           // R
  size_t triangle_count;  // T, halves and all
  // (T, 3) points
  uint32_t *corners;
  // (T) in the caller's mesh, with NSVCD__ENCLOSES where it belongs to a closed component
  uint32_t *ids;
  size_t cut_count;
  size_t most_cuts;
  // (most_cuts)
  nsvcd__d3 *cuts;
  // metres: a triangle with a longer edge is halved
  double longest_edge;

  // Of several regions:
  // what a triangle counts for its area and for being one, when regions are made alike
  double per_area, per_triangle;
  // (T) triangles, region by region
  uint32_t *order;
  // (T) working memory
  uint32_t *spare;
  // (vertices and cuts) the numbers of points in the region at hand, from 1; 0: none
  uint32_t *numbers;
  // (R + 1) places in `order`
  size_t *first;
} nsvcd__regions;

// A part of a mesh. Its last vertices are cuts.
typedef struct nsvcd__region {
  nsvcd_mesh mesh;  // welded
  // coordinate, of the whole mesh
  double greatest;
  // (triangles)
  uint32_t *ids;
  // (cut_count) where the cuts are; the mesh has them rounded
  nsvcd__d3 *cuts;
  size_t cut_count;
  // (vertices)
  uint8_t *seeds;
  // (vertices) their numbers among the points of all regions; NULL: the same
  uint32_t *vertices;
} nsvcd__region;

static nsvcd__d3 nsvcd__regions_point(const nsvcd__regions *r, uint32_t number) {
  const size_t vertices = r->mesh->vertex_count;
  if (number < vertices) return nsvcd__d3_row(r->mesh->positions, number);
  return r->cuts[number - vertices];
}

static nsvcd__triangle nsvcd__regions_place(const nsvcd__regions *r, const uint32_t *corners) {
  nsvcd__triangle out;
  out.at[0] = nsvcd__regions_point(r, corners[0]);
  out.at[1] = nsvcd__regions_point(r, corners[1]);
  out.at[2] = nsvcd__regions_point(r, corners[2]);
  return out;
}

// Adds a triangle, or its halves where an edge is too long, as long as there is room for these.
static void nsvcd__regions_add(nsvcd__regions *r, const uint32_t *corners, uint32_t id) {
  const nsvcd__triangle triangle = nsvcd__regions_place(r, corners);
  double e[3];
  const size_t k = nsvcd__edge_squares(&triangle, e);
  if (e[k] <= r->longest_edge * r->longest_edge || r->cut_count == r->most_cuts) {
    memcpy(r->corners + 3 * r->triangle_count, corners, 3 * sizeof *corners);
    r->ids[r->triangle_count++] = id;
    return;
  }
  const uint32_t middle = (uint32_t)(r->mesh->vertex_count + r->cut_count);
  const nsvcd__d3 sum = nsvcd__d3_add(triangle.at[k], triangle.at[(k + 1) % 3]);
  r->cuts[r->cut_count++] = nsvcd__d3_scale(sum, 0.5);
  const uint32_t near_a[3] = {corners[k], middle, corners[(k + 2) % 3]};
  const uint32_t near_b[3] = {middle, corners[(k + 1) % 3], corners[(k + 2) % 3]};
  nsvcd__regions_add(r, near_a, id);
  nsvcd__regions_add(r, near_b, id);
}

static nsvcd__triangle nsvcd__regions_triangle(const nsvcd__regions *r, size_t i) {
  return nsvcd__regions_place(r, r->corners + 3 * (size_t)r->order[i]);
}
static nsvcd__d3 nsvcd__centroid(const nsvcd__triangle *t) {
  const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(t->at[0], t->at[1]), t->at[2]);
  return nsvcd__d3_scale(sum, 1.0 / 3);
}

// Cuts a run of triangles, places first .. end - 1 of `order`, in two, such that the first part has
// about this share of the weight. Centroids decide: the cut is at the end of a bin across the
// longest axis of their box. In a part triangles keep their order. Returns where the second begins.
static size_t nsvcd__regions_split(const nsvcd__regions *r, size_t first, size_t end,
                                   double share) {
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = first; i < end; i++) {
    const nsvcd__triangle triangle = nsvcd__regions_triangle(r, i);
    const nsvcd__d3 at = nsvcd__centroid(&triangle);
    low = nsvcd__d3_min(low, at);
    high = nsvcd__d3_max(high, at);
  }
  const nsvcd__d3 size = nsvcd__d3_sub(high, low);
  size_t axis = size.y > size.x ? 1 : 0;
  if (size.z > nsvcd__d3_axis(size, axis)) axis = 2;
  const double longest = nsvcd__d3_axis(size, axis);
  const double per_metre = longest > 1e-30 ? NSVCD__REGION_BINS / longest : 0;

  double weights[NSVCD__REGION_BINS] = {0};
  double all = 0;
  for (size_t i = first; i < end; i++) {
    const nsvcd__triangle triangle = nsvcd__regions_triangle(r, i);
    const double weight = r->per_area * nsvcd__triangle_area(&triangle) + r->per_triangle;
    const nsvcd__d3 from_low = nsvcd__d3_sub(nsvcd__centroid(&triangle), low);
    const double bin =
        fmin(nsvcd__d3_axis(from_low, axis) * per_metre, NSVCD__REGION_BINS - 1);
    r->spare[i - first] = (uint32_t)bin;
    weights[(uint32_t)bin] += weight;
    all += weight;
  }
  uint32_t last_bin = 0;
  for (double sum = weights[0]; last_bin + 2 < NSVCD__REGION_BINS; last_bin++) {
    const double next = weights[last_bin + 1];
    if (!(sum + 0.5 * next < share * all)) break;
    sum += next;
  }

  // The second part waits in place of bins that have been looked at.
  size_t middle = first;
  size_t others = 0;
  for (size_t i = first; i < end; i++) {
    const uint32_t t = r->order[i];
    uint32_t *to = r->spare[i - first] <= last_bin ? &r->order[middle++] : &r->spare[others++];
    *to = t;
  }
  memcpy(r->order + middle, r->spare, others * sizeof *r->spare);
  return middle;
}

// Makes `parts` regions, from number n on, of a run of triangles.
static void nsvcd__regions_part(nsvcd__regions *r, size_t first, size_t end, size_t parts,
                                size_t n) {
  r->first[n] = first;
  if (parts == 1) return;
  const size_t left = parts / 2;
  const double share = (double)left / (double)parts;
  const size_t middle = nsvcd__regions_split(r, first, end, share);
  nsvcd__regions_part(r, first, middle, left, n);
  nsvcd__regions_part(r, middle, end, parts - left, n + left);
}

// Welds the mesh, and parts it where it is to have more than a region's patches. patches: N, of the
// whole. 0 without memory.
static int nsvcd__regions_build(const nsvcd_mesh *mesh, size_t patches, nsvcd__arena *arena,
                                nsvcd__regions *r) {
  nsvcd__arena scratch = nsvcd__arena_of(arena->allocator);
  nsvcd__topology topology;
  memset(r, 0, sizeof *r);
  r->mesh = mesh;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    r->greatest = fmax(r->greatest, fabs((double)mesh->positions[i]));
  r->count = 1;
  r->longest_edge = HUGE_VAL;
  if (patches > NSVCD_SMALL_PATCHES) {
    r->count = (patches + NSVCD__REGION_PATCHES - 1) / NSVCD__REGION_PATCHES;
    const double area = nsvcd__mesh_area(mesh);
    const double triangles = (double)mesh->triangle_count;
    const double most = triangles + NSVCD__HALVES_PER_REGION * (double)r->count;
    const double edge = NSVCD__REGION_EDGE * sqrt(area / (double)r->count);
    double pieces;
    r->per_area = 0.5 / area;
    r->longest_edge = nsvcd__raise_limit(mesh, edge, most, &pieces);
    // Lengths of halves are found there by formulas and later from their corners: roundings may
    // divide one more or less.
    r->most_cuts = (size_t)(pieces - triangles) + NSVCD__HALVES_PER_REGION;
  }

  const int known = nsvcd__topology_build(mesh, &scratch, &topology);
  const size_t most_triangles = mesh->triangle_count + r->most_cuts;
  r->component_count = topology.component_count;
  r->seeds = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  r->corners = NSVCD__TAKE(arena, uint32_t, 3 * most_triangles);
  r->ids = NSVCD__TAKE(arena, uint32_t, most_triangles);
  if (r->count > 1) {
    r->cuts = NSVCD__TAKE(arena, nsvcd__d3, r->most_cuts);
    r->order = NSVCD__TAKE(arena, uint32_t, most_triangles);
    r->spare = NSVCD__TAKE(arena, uint32_t, most_triangles);
    r->numbers = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count + r->most_cuts);
    r->first = NSVCD__TAKE(arena, size_t, r->count + 1);
  }
  const int ok = known && !arena->failed;
  if (ok) memcpy(r->seeds, topology.seen, mesh->vertex_count);
  for (size_t t = 0; ok && t < mesh->triangle_count; t++) {
    uint32_t face[3];
    nsvcd__welded_face(&topology, t, face);
    const int open = topology.open[topology.parents[face[0]]];
    nsvcd__regions_add(r, face, (uint32_t)t | (open ? 0 : NSVCD__ENCLOSES));
  }
  nsvcd__arena_free(&scratch);
  if (!ok || r->count == 1) return ok;

  r->per_triangle = 0.5 / (double)r->triangle_count;
  for (uint32_t t = 0; t < r->triangle_count; t++) r->order[t] = t;
  nsvcd__regions_part(r, 0, r->triangle_count, r->count, 0);
  r->first[r->count] = r->triangle_count;
  return 1;
}

// One of the regions. EMPTY where it has no triangle; MEMORY. After success: nsvcd__region_end.
static nsvcd_result nsvcd__region_begin(nsvcd__regions *r, size_t n, nsvcd__arena *arena,
                                        nsvcd__region *out) {
  memset(out, 0, sizeof *out);
  out->greatest = r->greatest;
  if (r->count == 1) {
    out->mesh = *r->mesh;
    out->mesh.indices = r->corners;
    out->ids = r->ids;
    out->seeds = r->seeds;
    return NSVCD_OK;
  }
  const uint32_t *order = r->order + r->first[n];
  const size_t count = r->first[n + 1] - r->first[n];
  if (count == 0) return NSVCD_ERROR_EMPTY;
  out->mesh.triangle_count = count;
  out->mesh.positions = NSVCD__TAKE(arena, float, 9 * count);
  out->mesh.indices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  out->ids = NSVCD__TAKE(arena, uint32_t, count);
  out->cuts = NSVCD__TAKE(arena, nsvcd__d3, 3 * count);
  out->seeds = NSVCD__TAKE(arena, uint8_t, 3 * count);
  out->vertices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  if (arena->failed) return NSVCD_ERROR_MEMORY;

  // points get their numbers within the region: first those that are no cuts
  size_t points = 0;
  for (int cuts = 0; cuts < 2; cuts++) {
    const size_t before = points;
    for (size_t i = 0; i < 3 * count; i++) {
      const uint32_t v = r->corners[3 * (size_t)order[i / 3] + i % 3];
      const int is_cut = v >= r->mesh->vertex_count;
      if (is_cut != cuts || r->numbers[v]) continue;
      out->vertices[points++] = v;
      r->numbers[v] = (uint32_t)points;
    }
    out->cut_count = points - before;
  }
  out->mesh.vertex_count = points;
  const size_t firm = points - out->cut_count;
  for (size_t i = 0; i < count; i++) {
    out->ids[i] = r->ids[order[i]];
    for (size_t k = 0; k < 3; k++)
      out->mesh.indices[3 * i + k] = r->numbers[r->corners[3 * (size_t)order[i] + k]] - 1;
  }
  for (size_t v = 0; v < points; v++) {
    const uint32_t from = out->vertices[v];
    const nsvcd__d3 at = nsvcd__regions_point(r, from);
    nsvcd__f3_store(nsvcd__f3_round(at), out->mesh.positions + 3 * v);
    if (v < firm) out->seeds[v] = r->seeds[from];
    if (v >= firm) out->cuts[v - firm] = at;
    r->numbers[from] = 0;
  }
  return NSVCD_OK;
}

// Keeps in mind which seeds patches have been given.
static void nsvcd__region_end(nsvcd__regions *r, const nsvcd__region *region) {
  const size_t firm = region->mesh.vertex_count - region->cut_count;
  for (size_t v = 0; region->vertices && v < firm; v++)
    r->seeds[region->vertices[v]] = region->seeds[v];
}
#endif  // NSVCD_NO_ENCODER

// ====================================================== surface: each patch described from outside

// ---------------------------------------------------------------------------------- surface/pieces
// In: a mesh, region by region, and the centres of each region's patches, N in all. Out: pieces:
// triangles, cut by the cells of the centres. From them nsvcd__surface is made (surface/surface):
// of every patch an outer description of the surface that belongs to it, and the triangles of that
// surface. A proof of freedom of collision is built on it.
//
// What holds. Every point of the mesh lies in a piece. Every piece is a convex part of one
// triangle, and belongs to one patch. That patch lists the piece's triangle, or the piece itself
// where the triangle is large beside the patches. Its ball, its disc and its hull swollen by the
// slack contain the piece. Triangles without area are surface like others.
//
// Why it holds. A piece is only ever divided in two parts that share the corners between them, and
// both parts are kept. So the pieces cover the mesh whatever the cuts are, and poor cuts can make a
// description only larger. Each number is taken from the corners of the pieces, about what is
// stored in float, and then rounded outwards. A piece is the convex hull of its corners, and so are
// ball, disc and swollen hull convex: what contains the corners contains the piece. The corners
// themselves are off by roundings of double: all bounds are wider by NSVCD__SURFACE_MARGIN.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// mean sample radii: how far a piece may extend into another cell
#define NSVCD__SURFACE_OVERLAP 0.5
// mean sample radii: with a longer edge a triangle is listed in parts
#define NSVCD__SURFACE_WHOLE 16.0
// of the mesh's greatest coordinate
#define NSVCD__SURFACE_MARGIN 1e-13
// metres, added to that: keeps clear of what float cannot hold
#define NSVCD__SURFACE_TINY 1e-30
// of the radius: a hull as near as this to all corners is good
#define NSVCD__HULL_SHARE 1e-4
// corners of a piece, at most
#define NSVCD__PIECE_CORNERS 16
// polygons that wait for their turn (12 at most were seen)
#define NSVCD__WAITING 64
// These two bound the cuts. A fine mesh needs less than one for each triangle, a large face some
// three for each of its patches.
#define NSVCD__CUTS_PER_TRIANGLE 8
#define NSVCD__CUTS_PER_PATCH 64
// vertices and new corners together have numbers of 32 bits
#define NSVCD__MAX_CUTS (1u << 29)
// as many as corners of 16 bits can name
#define NSVCD__PATCH_VERTICES 65536u

// ---- lists that grow

// As zeros it is empty.
typedef struct nsvcd__list {
  void *items;
  size_t count, capacity;
} nsvcd__list;

// Room for `more` items of so many bytes; 0 without memory, and the list is as it was.
static int nsvcd__list_reserve(nsvcd__list *list, size_t more, size_t size,
                               nsvcd__arena *arena) {
  if (list->capacity - list->count >= more) return 1;
  if (list->count > SIZE_MAX / 2 - more) return 0;
  const size_t capacity = list->count + more + list->count / 2;
  void *items = nsvcd__arena_grow(arena, list->items, list->count * size, capacity, size);
  if (!items) return 0;
  list->items = items;
  list->capacity = capacity;
  return 1;
}

typedef struct nsvcd__surface {
  // of all its arrays
  nsvcd__arena *arena;
  size_t count;  // N, of which
  size_t done;   // so many are described by now
  // L, triangles listed, over all patches
  size_t listed;
  // V, vertices stored, over all patches
  size_t vertex_count;
  // C, connected components (vertices at the same place are one vertex)
  size_t component_count;
  // (N) about c; an empty patch has radius NSVCD__NOWHERE
  nsvcd__sphere *balls;
  // (N) about c
  nsvcd__disc *discs;
  // (N) metres per integer: a stored vertex is c + step * (x, y, z)
  float *steps;
  // (N) metres: every point of a piece is within this of the convex hull of the first
  // hull_counts[i] stored vertices
  float *slacks;
  // (N) metres: every corner listed is within this of its stored vertex
  float *quanta;
  // (N) 1..NSVCD__HULL; 0 where empty
  uint8_t *hull_counts;
  // (N + 1)
  uint32_t *first_vertex;
  uint32_t *first_triangle;  // (N + 1)
  // patch i: x of its vertices, then y, then z, at 3 * first_vertex[i]
  int16_t *vertices;
  // (L, 3) numbers of vertices within the patch
  uint16_t *corners;
  // (L) triangle of the mesh. With NSVCD__ENCLOSES where it belongs to a closed component
  uint32_t *ids;
  // so many of the C components are known by now
  size_t seed_count;
  // (C) a vertex of each component
  nsvcd__f3 *seeds;
  // (C) a patch with a piece that has it for a corner
  uint32_t *seed_patches;
  // where vertices, corners and ids are
  nsvcd__list vertex_list, corner_list, id_list;
} nsvcd__surface;

// ---- pieces: triangles cut by the cells of the centres

// A convex part of one triangle that is being cut. Its corners are points by number: the mesh's
// welded vertices, then those that cuts have made. While it is divided it may have too many.
typedef struct nsvcd__convex {
  uint32_t points[2 * NSVCD__PIECE_CORNERS];
  size_t count;
} nsvcd__convex;

typedef struct nsvcd__piece {
  // of its corners; NSVCD__WHOLE: they are the triangle's
  uint32_t first;
  uint32_t triangle;
  uint16_t patch;
  uint8_t count;  // of its corners
  // 1: its triangle is listed in parts
  uint8_t parted;
} nsvcd__piece;

#define NSVCD__WHOLE 0xffffffffu

typedef struct nsvcd__pieces {
  nsvcd__arena *arena;
  const nsvcd__region *region;
  const nsvcd__patches *patches;
  // of nsvcd__piece, triangle by triangle
  nsvcd__list list;
  nsvcd__list corners;  // of uint32_t, numbers of points
  // of nsvcd__d3: the points that cuts have made
  nsvcd__list points;
  // (NSVCD__WAITING)
  nsvcd__convex *waiting;
  size_t waiting_count;
  size_t cuts_left;
  // metres: how far a piece may extend beyond its cell
  double overlap;
  // metres: a triangle with a longer edge is listed in parts
  double longest_edge;
  // metres, added to all bounds
  double margin;
  // metres: discs need not be thinner
  double thin;
} nsvcd__pieces;

static const uint32_t *nsvcd__triangle_corners(const nsvcd__pieces *pieces,
                                               uint32_t triangle) {
  return pieces->region->mesh.indices + 3 * (size_t)triangle;
}
static const uint32_t *nsvcd__piece_corners(const nsvcd__pieces *pieces,
                                            const nsvcd__piece *piece) {
  if (piece->first == NSVCD__WHOLE) return nsvcd__triangle_corners(pieces, piece->triangle);
  return (const uint32_t *)pieces->corners.items + piece->first;
}

static nsvcd__d3 nsvcd__point_at(const nsvcd__pieces *pieces, uint32_t number) {
  const nsvcd__region *region = pieces->region;
  const nsvcd__d3 *made = (const nsvcd__d3 *)pieces->points.items;
  const size_t vertices = region->mesh.vertex_count;
  const size_t firm = vertices - region->cut_count;
  if (number < firm) return nsvcd__d3_row(region->mesh.positions, number);
  if (number < vertices) return region->cuts[number - firm];
  return made[number - vertices];
}

// Divides a polygon where `beyond`, a value at each of its corners, changes its sign: near_part is
// where it is negative. There is room for the points that this makes. 0 if one of the parts has
// less than three corners, which roundings can do, or too many.
static int nsvcd__divide(nsvcd__pieces *pieces, const nsvcd__convex *from,
                         const double *beyond, nsvcd__convex *near_part,
                         nsvcd__convex *far_part) {
  const uint32_t vertices = (uint32_t)pieces->region->mesh.vertex_count;
  const size_t made = pieces->points.count;
  nsvcd__d3 *points = (nsvcd__d3 *)pieces->points.items;
  near_part->count = 0;
  far_part->count = 0;
  for (size_t i = 0; i < from->count; i++) {
    const size_t j = (i + 1) % from->count;
    if (beyond[i] <= 0) near_part->points[near_part->count++] = from->points[i];
    if (beyond[i] >= 0) far_part->points[far_part->count++] = from->points[i];
    const int leaves = beyond[i] < 0 && beyond[j] > 0;
    const int enters = beyond[i] > 0 && beyond[j] < 0;
    if (!leaves && !enters) continue;
    const nsvcd__d3 a = nsvcd__point_at(pieces, from->points[i]);
    const nsvcd__d3 b = nsvcd__point_at(pieces, from->points[j]);
    const uint32_t number = vertices + (uint32_t)pieces->points.count;
    const double share = beyond[i] / (beyond[i] - beyond[j]);
    points[pieces->points.count++] = nsvcd__d3_mix(a, b, share);
    near_part->points[near_part->count++] = number;
    far_part->points[far_part->count++] = number;
  }
  const size_t most = NSVCD__PIECE_CORNERS;
  if (near_part->count >= 3 && near_part->count <= most && far_part->count >= 3 &&
      far_part->count <= most)
    return 1;
  pieces->points.count = made;
  return 0;
}

// Distance of the polygon's farthest corner.
static double nsvcd__convex_reach(const nsvcd__pieces *pieces, const nsvcd__convex *convex,
                                  nsvcd__d3 from) {
  double squared = 0;
  for (size_t i = 0; i < convex->count; i++) {
    const nsvcd__d3 at = nsvcd__point_at(pieces, convex->points[i]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(at, from));
  }
  return sqrt(squared);
}

// Cuts from the polygon what lies too far beyond its patch's cell; that waits for its turn. 0
// without memory.
static int nsvcd__trim(nsvcd__pieces *pieces, uint32_t patch, nsvcd__convex *convex) {
  const nsvcd__patches *patches = pieces->patches;
  const nsvcd__d3 own = nsvcd__d3_widen(patches->centres[patch]);
  const size_t first = (size_t)patch * NSVCD__NEIGHBOURS;
  double reach = nsvcd__convex_reach(pieces, convex, own);
  for (size_t k = first; k < first + NSVCD__NEIGHBOURS; k++) {
    // The plane is half the gap away, and the planes of all that follow are farther.
    const double plane = sqrt((double)patches->quarter_squares[k]);
    if (reach <= plane + pieces->overlap) break;
    if (pieces->cuts_left == 0 || pieces->waiting_count == NSVCD__WAITING) break;
    const nsvcd__d3 other = nsvcd__d3_widen(patches->centres[patches->neighbours[k]]);
    const nsvcd__d3 across = nsvcd__d3_sub(other, own);
    const nsvcd__d3 middle = nsvcd__d3_mix(own, other, 0.5);
    const double length = nsvcd__d3_length(across);
    double beyond[NSVCD__PIECE_CORNERS];
    double most = -HUGE_VAL;
    for (size_t i = 0; i < convex->count; i++) {
      const nsvcd__d3 at = nsvcd__point_at(pieces, convex->points[i]);
      const double height = nsvcd__d3_dot(nsvcd__d3_sub(at, middle), across);
      beyond[i] = length > 0 ? height / length : -1;
      most = nsvcd__max(most, beyond[i]);
    }
    if (most <= pieces->overlap) continue;
    nsvcd__list *points = &pieces->points;
    if (!nsvcd__list_reserve(points, convex->count, sizeof own, pieces->arena)) return 0;
    nsvcd__convex near_part;
    nsvcd__convex *far_part = &pieces->waiting[pieces->waiting_count];
    if (!nsvcd__divide(pieces, convex, beyond, &near_part, far_part)) continue;
    *convex = near_part;
    pieces->waiting_count++;
    pieces->cuts_left--;
    reach = nsvcd__convex_reach(pieces, convex, own);
  }
  return 1;
}

// Cuts one triangle into pieces. guess: the patch of the piece before. 0 without memory.
static int nsvcd__cut_up(nsvcd__pieces *pieces, uint32_t triangle, uint32_t *guess) {
  const uint32_t *corners = nsvcd__triangle_corners(pieces, triangle);
  nsvcd__piece piece = {NSVCD__WHOLE, triangle, 0, 0, 0};
  double squared = 0;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 a = nsvcd__point_at(pieces, corners[k]);
    const nsvcd__d3 b = nsvcd__point_at(pieces, corners[(k + 1) % 3]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(a, b));
    pieces->waiting[0].points[k] = corners[k];
  }
  piece.parted = sqrt(squared) > pieces->longest_edge;
  pieces->waiting[0].count = 3;
  pieces->waiting_count = 1;
  while (pieces->waiting_count > 0) {
    nsvcd__convex convex = pieces->waiting[--pieces->waiting_count];
    nsvcd__d3 sum = nsvcd__d3_of(0, 0, 0);
    for (size_t i = 0; i < convex.count; i++)
      sum = nsvcd__d3_add(sum, nsvcd__point_at(pieces, convex.points[i]));
    const nsvcd__d3 mean = nsvcd__d3_scale(sum, 1 / (double)convex.count);
    *guess = nsvcd__nearest_centre(pieces->patches, *guess, nsvcd__d3_narrow(mean));
    piece.patch = (uint16_t)*guess;
    if (!nsvcd__trim(pieces, piece.patch, &convex)) return 0;

    nsvcd__list *list = &pieces->corners;
    const size_t bytes = convex.count * sizeof *corners;
    piece.count = (uint8_t)convex.count;
    piece.first = NSVCD__WHOLE;
    if (convex.count != 3 || memcmp(convex.points, corners, bytes) != 0) {
      if (list->count >= NSVCD__WHOLE - NSVCD__PIECE_CORNERS) return 0;
      if (!nsvcd__list_reserve(list, convex.count, sizeof *corners, pieces->arena)) return 0;
      memcpy((uint32_t *)list->items + list->count, convex.points, bytes);
      piece.first = (uint32_t)list->count;
      list->count += convex.count;
    }
    list = &pieces->list;
    if (!nsvcd__list_reserve(list, 1, sizeof piece, pieces->arena)) return 0;
    ((nsvcd__piece *)list->items)[list->count++] = piece;
  }
  return 1;
}

// Cuts the whole region. 0 without memory.
static int nsvcd__pieces_build(const nsvcd__region *region, const nsvcd__patches *patches,
                               nsvcd__arena *arena, nsvcd__pieces *pieces) {
  const size_t triangles = region->mesh.triangle_count;
  double size = 0;
  for (size_t i = 0; i < patches->count; i++) size += (double)patches->sample_radii[i];
  size /= (double)patches->count;
  memset(pieces, 0, sizeof *pieces);
  pieces->arena = arena;
  pieces->region = region;
  pieces->patches = patches;
  pieces->margin = NSVCD__SURFACE_MARGIN * region->greatest + NSVCD__SURFACE_TINY;
  pieces->overlap = NSVCD__SURFACE_OVERLAP * size + pieces->margin;
  pieces->longest_edge = NSVCD__SURFACE_WHOLE * size;
  pieces->cuts_left = NSVCD__CUTS_PER_PATCH * patches->count;
  const size_t room = NSVCD__MAX_CUTS - pieces->cuts_left;
  const int many = triangles > room / NSVCD__CUTS_PER_TRIANGLE;
  pieces->cuts_left += many ? room : NSVCD__CUTS_PER_TRIANGLE * triangles;

  pieces->waiting = NSVCD__TAKE(arena, nsvcd__convex, NSVCD__WAITING);
  // Most triangles are one piece: with room for an eighth more the list seldom needs to grow, which
  // takes it twice.
  const size_t most = triangles + triangles / 8;
  int ok =
      pieces->waiting && nsvcd__list_reserve(&pieces->list, most, sizeof(nsvcd__piece), arena);
  uint32_t guess = 0;
  for (uint32_t t = 0; ok && t < triangles; t++) ok = nsvcd__cut_up(pieces, t, &guess);
  return ok;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------ surface/runs
// In: a mesh of points, segments and triangles, which may all be without area. Out: its pieces, as
// of a region of its own: all triangles whole, in runs of neighbours, each of which is a patch.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// triangles of a run, where there are many: no more points than a hull may have
#define NSVCD__RUN_LENGTH 16
// runs that are worked on at a time, in memory that stays near
#define NSVCD__RUNS_AT_ONCE 256
// of how round a body is: where its discs are thinner, they are not made thinner still
#define NSVCD__RUN_THIN 0.5

// Is some triangle of a mesh a point or a segment? One without indices is a cloud.
static int nsvcd__has_points(const nsvcd_mesh *mesh) {
  if (!mesh->indices) return 1;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const uint32_t *v = mesh->indices + 3 * t;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return 1;
  }
  return 0;
}

// How many runs there are to be, where the options do not say.
static size_t nsvcd__runs_for(const nsvcd_mesh *mesh) {
  const size_t triangles = mesh->triangle_count;
  const size_t runs = (triangles + NSVCD__RUN_LENGTH - 1) / NSVCD__RUN_LENGTH;
  if (triangles <= NSVCD_VERY_FEW_TRIANGLES) return triangles;
  return runs < NSVCD_MAX_PATCHES ? runs : NSVCD_MAX_PATCHES;
}

static nsvcd__f3 nsvcd__middle_of(const nsvcd_mesh *mesh, size_t t) {
  const uint32_t point[3] = {(uint32_t)t, (uint32_t)t, (uint32_t)t};
  const uint32_t *v = mesh->indices ? mesh->indices + 3 * t : point;
  nsvcd__f3 sum = nsvcd__f3_row(mesh->positions, v[0]);
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[1]));
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[2]));
  return nsvcd__f3_scale(sum, 1.0f / 3);
}

// The bits of the whole part, up to 10, three places apart.
static uint64_t nsvcd__spread_bits(float from) {
  uint32_t x = (uint32_t)from;
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Sorts numbers by their upper half, 8 bits at a time; equal ones keep their order. spare:
// (count).
static void nsvcd__sort_by_code(uint64_t *keys, uint64_t *spare, size_t count) {
  for (unsigned shift = 32; shift < 64; shift += 8) {
    size_t first[257] = {0};
    uint64_t *from = shift & 8 ? spare : keys;
    uint64_t *to = shift & 8 ? keys : spare;
    for (size_t i = 0; i < count; i++) first[1 + (from[i] >> shift & 0xff)]++;
    for (size_t n = 0; n < 256; n++) first[n + 1] += first[n];
    for (size_t i = 0; i < count; i++) to[first[from[i] >> shift & 0xff]++] = from[i];
  }
}

// A mesh along a curve that fills space (Morton 1966).
typedef struct nsvcd__curve {
  const nsvcd_mesh *mesh;
  // (triangles) each number of a triangle below its code
  uint64_t *keys;
  // (vertices) when a vertex was met last, from 1, counting all that a block has met; 0: not yet.
  // None of a cloud, which has each once
  uint32_t *met;
  uint32_t met_count;
  double greatest;  // coordinate of the mesh
  double round;     // metres
} nsvcd__curve;

// 0 without memory.
static int nsvcd__curve_build(const nsvcd_mesh *mesh, float round, nsvcd__arena *arena,
                              nsvcd__curve *curve) {
  const size_t count = mesh->triangle_count;
  memset(curve, 0, sizeof *curve);
  curve->mesh = mesh;
  curve->round = (double)round;
  curve->keys = NSVCD__TAKE(arena, uint64_t, 2 * count);
  curve->met = NSVCD__TAKE(arena, uint32_t, mesh->indices ? mesh->vertex_count : 0);
  if (arena->failed) return 0;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    curve->greatest = nsvcd__max(curve->greatest, fabs((double)mesh->positions[i]));
  nsvcd__f3 low = nsvcd__middle_of(mesh, 0);
  nsvcd__f3 high = low;
  for (size_t t = 0; t < count; t++) {
    const nsvcd__f3 middle = nsvcd__middle_of(mesh, t);
    low = nsvcd__f3_min(low, middle);
    high = nsvcd__f3_max(high, middle);
  }
  const nsvcd__f3 size = nsvcd__f3_sub(high, low);
  const float longest = fmaxf(fmaxf(size.x, size.y), size.z);
  const float cells = longest > 0 ? 1023 / longest : 0;
  for (size_t t = 0; t < count; t++) {
    const nsvcd__f3 at = nsvcd__f3_sub(nsvcd__middle_of(mesh, t), low);
    const uint64_t x = nsvcd__spread_bits(cells * at.x);
    const uint64_t y = nsvcd__spread_bits(cells * at.y);
    const uint64_t z = nsvcd__spread_bits(cells * at.z);
    curve->keys[t] = (x | y << 1 | z << 2) << 32 | t;
  }
  nsvcd__sort_by_code(curve->keys, curve->keys + count, count);
  return 1;
}

// The first triangle of a run, none of which is empty.
static size_t nsvcd__run_begin(size_t triangles, size_t run, size_t runs) {
  return (size_t)(((uint64_t)triangles * run + runs - 1) / runs);
}

// Runs first to last - 1 of so many, of which each is a patch; block and patches are what they are
// pieces of. A block's triangles and vertices are copied in the order of the curve: all that
// follows reads memory from front to back. Every triangle may be of a component of its own, if none
// of its vertices has been met. 0 without memory.
static int nsvcd__runs_build(nsvcd__curve *curve, size_t first, size_t last, size_t runs,
                             nsvcd__arena *arena, nsvcd__region *block,
                             nsvcd__patches *patches, nsvcd__pieces *pieces) {
  const nsvcd_mesh *mesh = curve->mesh;
  const size_t all = mesh->triangle_count;
  const size_t begin = nsvcd__run_begin(all, first, runs);
  const size_t count = nsvcd__run_begin(all, last, runs) - begin;
  const uint32_t before = curve->met_count;
  memset(block, 0, sizeof *block);
  memset(patches, 0, sizeof *patches);
  memset(pieces, 0, sizeof *pieces);
  block->mesh.triangle_count = count;
  const size_t most = 3 * count < mesh->vertex_count ? 3 * count : mesh->vertex_count;
  block->mesh.positions = NSVCD__TAKE(arena, float, 3 * most);
  block->mesh.indices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  block->ids = NSVCD__TAKE(arena, uint32_t, count);
  uint32_t *origins = NSVCD__TAKE(arena, uint32_t, most);
  block->seeds = NSVCD__TAKE(arena, uint8_t, most);
  block->greatest = curve->greatest;
  patches->count = last - first;
  patches->centres = NSVCD__TAKE(arena, nsvcd__f3, patches->count);
  pieces->arena = arena;
  pieces->region = block;
  pieces->patches = patches;
  pieces->margin = NSVCD__SURFACE_MARGIN * block->greatest + NSVCD__SURFACE_TINY;
  pieces->thin = NSVCD__RUN_THIN * curve->round;
  if (!nsvcd__list_reserve(&pieces->list, count, sizeof(nsvcd__piece), arena)) return 0;
  if (arena->failed) return 0;
  nsvcd__piece *out = (nsvcd__piece *)pieces->list.items;
  pieces->list.count = count;
  // Short loops, each of which waits for memory far away, for many places at a time.
  size_t run = first;
  size_t end = 0;
  for (size_t k = 0; k < count; k++) {
    if (k == end) end = nsvcd__run_begin(all, ++run, runs) - begin;
    const nsvcd__piece piece = {NSVCD__WHOLE, (uint32_t)k, (uint16_t)(run - 1 - first), 3, 0};
    out[k] = piece;
    block->ids[k] = (uint32_t)curve->keys[begin + k];
    for (size_t n = 3 * k; n < 3 * k + 3; n++) {
      const size_t corner = 3 * (size_t)block->ids[k] + n - 3 * k;
      block->mesh.indices[n] = mesh->indices ? mesh->indices[corner] : (uint32_t)k;
    }
  }
  if (!mesh->indices) {
    memcpy(origins, block->ids, count * sizeof *origins);
    memset(block->seeds, 1, count);
    block->mesh.vertex_count = count;
  }
  for (size_t n = 0; mesh->indices && n < 3 * count; n++) {
    const uint32_t *face = &block->mesh.indices[n / 3 * 3];
    uint32_t *met = &curve->met[block->mesh.indices[n]];
    if (*met <= before) {
      block->seeds[block->mesh.vertex_count] =
          n % 3 == 0 && !curve->met[face[0]] && !curve->met[face[1]] && !curve->met[face[2]];
      origins[block->mesh.vertex_count++] = block->mesh.indices[n];
      *met = ++curve->met_count;
    }
    block->mesh.indices[n] = *met - 1 - before;
  }
  for (size_t i = 0; i < block->mesh.vertex_count; i++) {
    const nsvcd__f3 at = nsvcd__f3_row(mesh->positions, origins[i]);
    nsvcd__f3_store(at, block->mesh.positions + 3 * i);
  }
  return 1;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- surface/balls
// In: points, in double. Out: the least ball that holds them all, in float, rounded outwards; how
// to round outwards.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
static float nsvcd__float_above(double x) {
  const float rounded = nsvcd__to_float(x);
  return (double)rounded < x ? nextafterf(rounded, HUGE_VALF) : rounded;
}

// ---- balls: the least one that holds all points

typedef struct nsvcd__points {
  const nsvcd__d3 *at;  // (count)
  size_t count;
} nsvcd__points;

typedef struct nsvcd__ball {
  nsvcd__d3 centre;
  double squared;  // radius
} nsvcd__ball;

// The edges from the first of 1 to 4 points to the others, and shares of them. The sum of the
// shares leads from that point to the centre of the least ball with all points on its border; or,
// where `ball` is 0, to the point nearest to the origin of the plane (line, point) through them. 0
// if that is not known, for the points are too much in line, or in a plane.
static int nsvcd__solve_shares(const nsvcd__d3 *points, size_t count, int ball,
                               nsvcd__d3 *edges, double *b) {
  const size_t n = count - 1;
  double a[3][3] = {{0}};
  double first[3];
  for (size_t i = 0; i < n; i++) {
    edges[i] = nsvcd__d3_sub(points[i + 1], points[0]);
    first[i] = nsvcd__d3_dot(edges[i], edges[i]);
    b[i] = ball ? 0.5 * first[i] : -nsvcd__d3_dot(edges[i], points[0]);
    for (size_t j = 0; j <= i; j++) a[j][i] = nsvcd__d3_dot(edges[i], edges[j]);
  }
  // The matrix is symmetric and positive definite: its upper half is enough, and no pivots.
  for (size_t i = 0; i < n; i++) {
    if (!(a[i][i] > 1e-13 * first[i])) return 0;
    for (size_t j = i + 1; j < n; j++) {
      const double factor = a[i][j] / a[i][i];
      for (size_t k = j; k < n; k++) a[j][k] -= factor * a[i][k];
      b[j] -= factor * b[i];
    }
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t j = i + 1; j < n; j++) b[i] -= a[i][j] * b[j];
    b[i] /= a[i][i];
  }
  return 1;
}

// The least ball with all these 1 to 4 points on its border. 0 if there is none.
static int nsvcd__ball_through(const nsvcd__d3 *points, size_t count, nsvcd__ball *ball) {
  nsvcd__d3 edges[3];
  double shares[3];
  if (!nsvcd__solve_shares(points, count, 1, edges, shares)) return 0;
  nsvcd__d3 offset = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i + 1 < count; i++) offset = nsvcd__d3_fma(shares[i], edges[i], offset);
  ball->centre = nsvcd__d3_add(points[0], offset);
  ball->squared = nsvcd__d3_dot(offset, offset);
  return 1;
}

// Up to five points that a ball may go through.
typedef struct nsvcd__border {
  nsvcd__d3 points[5];
  size_t count;
} nsvcd__border;

// The least ball that holds the border (1 to 5 points) among those through the last of them and up
// to three others. Keeps in the border only the points that it goes through. 0 if there is none.
static NSVCD__APART int nsvcd__ball_of_few(nsvcd__border *border, nsvcd__ball *ball) {
  const unsigned last = 1u << (border->count - 1);
  unsigned best = 0;
  for (unsigned set = last; set < 2 * last; set++) {
    nsvcd__border chosen;
    nsvcd__ball trial;
    chosen.count = 0;
    for (size_t i = 0; i < border->count; i++) {
      if (set >> i & 1) chosen.points[chosen.count++] = border->points[i];
    }
    if (chosen.count > 4 || !nsvcd__ball_through(chosen.points, chosen.count, &trial))
      continue;
    int holds = !best || trial.squared < ball->squared;
    const double most = trial.squared * (1 + 1e-9);
    for (size_t i = 0; i < border->count; i++)
      holds &= nsvcd__d3_distance2(border->points[i], trial.centre) <= most;
    if (!holds) continue;
    best = set;
    *ball = trial;
  }
  if (!best) return 0;
  size_t kept = 0;
  for (size_t i = 0; i < border->count; i++) {
    if (best >> i & 1) border->points[kept++] = border->points[i];
  }
  border->count = kept;
  return 1;
}

// The centre of the least enclosing ball: the point farthest outside joins the border, until there
// is none (after Gaertner, "Fast and robust smallest enclosing balls", 1999). The ball grows with
// every step. Roundings can end it early: then it is a little too large, for the caller takes the
// radius from the points.
static nsvcd__d3 nsvcd__ball_centre(nsvcd__points points) {
  nsvcd__ball ball = {points.at[0], 0};
  nsvcd__border border;
  border.points[0] = points.at[0];
  border.count = 1;
  for (size_t step = 0; step < 64; step++) {
    double most = -1;
    size_t farthest = 0;
    for (size_t i = 0; i < points.count; i++) {
      const double square = nsvcd__d3_distance2(points.at[i], ball.centre);
      if (square > most) farthest = i;
      most = nsvcd__max(most, square);
    }
    if (most <= ball.squared * (1 + 1e-9)) break;
    border.points[border.count++] = points.at[farthest];
    nsvcd__ball larger = ball;
    if (!nsvcd__ball_of_few(&border, &larger)) break;
    if (larger.squared <= ball.squared) break;
    ball = larger;
  }
  return ball.centre;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- surface/discs
// In: points. Out: a disc: a direction in which the points are thin, what they reach along it, and
// across.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// What points extend to along a direction.
typedef struct nsvcd__range {
  double low, high;
} nsvcd__range;

static nsvcd__range nsvcd__range_along(nsvcd__points points, nsvcd__d3 direction) {
  nsvcd__range range = {HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < points.count; i++) {
    const double at = nsvcd__d3_dot(points.at[i], direction);
    range.low = at < range.low ? at : range.low;
    range.high = at > range.high ? at : range.high;
  }
  return range;
}

static double nsvcd__thickness(nsvcd__points points, nsvcd__d3 direction) {
  const nsvcd__range range = nsvcd__range_along(points, direction);
  return range.high - range.low;
}

// Some direction across a unit vector.
static nsvcd__d3 nsvcd__any_across(nsvcd__d3 n) {
  const int x_least = fabs(n.x) <= fabs(n.y) && fabs(n.x) <= fabs(n.z);
  const int y_least = fabs(n.y) <= fabs(n.z);
  nsvcd__d3 axis = nsvcd__d3_of(0, 0, 1);
  if (y_least) axis = nsvcd__d3_of(0, 1, 0);
  if (x_least) axis = nsvcd__d3_of(1, 0, 0);
  return nsvcd__d3_unit(nsvcd__d3_cross(n, axis), n);
}

static double nsvcd__trace(const nsvcd__dmat3 *m) {
  return m->x.x + m->y.y + m->z.z;
}

static nsvcd__d3 nsvcd__longest_row(const nsvcd__dmat3 *m) {
  const double x = nsvcd__d3_dot(m->x, m->x);
  const double y = nsvcd__d3_dot(m->y, m->y);
  const double z = nsvcd__d3_dot(m->z, m->z);
  if (x >= y && x >= z) return m->x;
  return y >= z ? m->y : m->z;
}

// Near the direction in which the points vary least. The adjugate of the covariance has the same
// axes, and the least becomes the largest: squaring that a few times leaves nothing else.
static nsvcd__d3 nsvcd__least_axis(nsvcd__points points) {
  const nsvcd__d3 zero = nsvcd__d3_of(0, 0, 0);
  nsvcd__dmat3 c = {zero, zero, zero};
  nsvcd__d3 mean = zero;
  for (size_t i = 0; i < points.count; i++) mean = nsvcd__d3_add(mean, points.at[i]);
  mean = nsvcd__d3_scale(mean, 1 / (double)points.count);
  for (size_t i = 0; i < points.count; i++) {
    const nsvcd__d3 d = nsvcd__d3_sub(points.at[i], mean);
    c.x = nsvcd__d3_fma(d.x, d, c.x);
    c.y = nsvcd__d3_fma(d.y, d, c.y);
    c.z = nsvcd__d3_fma(d.z, d, c.z);
  }
  const nsvcd__d3 z = nsvcd__d3_of(0, 0, 1);
  const nsvcd__d3 along = nsvcd__d3_unit(nsvcd__longest_row(&c), z);
  const double size = nsvcd__trace(&c);
  nsvcd__dmat3 m;
  m.x = nsvcd__d3_cross(c.y, c.z);
  m.y = nsvcd__d3_cross(c.z, c.x);
  m.z = nsvcd__d3_cross(c.x, c.y);
  // a line
  if (!(nsvcd__trace(&m) > 1e-14 * size * size)) return nsvcd__any_across(along);
  for (size_t step = 0; step < 6; step++) {
    const double trace = nsvcd__trace(&m);
    nsvcd__dmat3 square;
    square.x = nsvcd__dmat3_apply(&m, m.x);
    square.y = nsvcd__dmat3_apply(&m, m.y);
    square.z = nsvcd__dmat3_apply(&m, m.z);
    m = nsvcd__dmat3_scale(&square, trace > 0 ? 1 / (trace * trace) : 0);
  }
  return nsvcd__d3_unit(nsvcd__longest_row(&m), nsvcd__any_across(along));
}

// Turns a direction step by step to where the points are thinner, until they are thin.
static nsvcd__d3 nsvcd__thinner(nsvcd__points points, nsvcd__d3 direction, double thin) {
  double best = nsvcd__thickness(points, direction);
  for (double turn = 0.16; turn > 0.005 && best > thin; turn *= 0.5) {
    const nsvcd__d3 u = nsvcd__any_across(direction);
    const nsvcd__d3 v = nsvcd__d3_cross(direction, u);
    const nsvcd__d3 middle = direction;
    for (size_t k = 0; k < 4; k++) {
      const nsvcd__d3 step = nsvcd__d3_scale(k < 2 ? u : v, k % 2 ? -turn : turn);
      const nsvcd__d3 trial = nsvcd__d3_unit(nsvcd__d3_add(middle, step), middle);
      const double thickness = nsvcd__thickness(points, trial);
      if (thickness >= best) continue;
      best = thickness;
      direction = trial;
    }
  }
  return direction;
}

// points: about the centre of the patch's ball. normal: the mean one of its pieces, of any length.
// thin: metres; thinner than that is of no use.
static nsvcd__disc nsvcd__fit_disc(nsvcd__points points, nsvcd__d3 normal, double margin,
                                   double thin) {
  nsvcd__d3 best = nsvcd__least_axis(points);
  const nsvcd__d3 mean = nsvcd__d3_unit(normal, best);
  if (nsvcd__thickness(points, mean) < nsvcd__thickness(points, best)) best = mean;
  best = nsvcd__thinner(points, best, thin);
  if (nsvcd__d3_dot(best, normal) < 0) best = nsvcd__d3_scale(best, -1);

  // Shorter than 1 by more than the roundings: |n| <= 1 holds for what is stored.
  const nsvcd__f3 n = nsvcd__f3_round(nsvcd__d3_scale(best, 1 - 1.5e-7));
  const nsvcd__d3 stored = nsvcd__d3_widen(n);
  const nsvcd__range range = nsvcd__range_along(points, stored);
  double squared = 0;
  for (size_t i = 0; i < points.count; i++) {
    const nsvcd__d3 moment = nsvcd__d3_cross(points.at[i], stored);
    squared = nsvcd__max(squared, nsvcd__d3_dot(moment, moment));
  }
  const double across = sqrt(squared / nsvcd__d3_dot(stored, stored));
  nsvcd__disc disc;
  disc.normal = n;
  disc.low = -nsvcd__float_above(-(range.low - margin));
  disc.high = nsvcd__float_above(range.high + margin);
  disc.across = nsvcd__float_above(across * (1 + 1e-6) + margin);
  return disc;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- surface/hulls
// In: points. Out: 16 of them whose hull, swollen by a slack, holds all.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// The point of a simplex nearest to the origin: weights are positive and sum to 1.
typedef struct nsvcd__simplex {
  nsvcd__d3 points[4];
  double weights[4];
  size_t count;
} nsvcd__simplex;

// Moves the weights to the simplex's point nearest to the origin, and drops the corners that do not
// bear it (Wolfe, "Finding the nearest point in a polytope", 1976). 0 if roundings are in the way:
// the weights still are weights.
static int nsvcd__simplex_settle(nsvcd__simplex *s) {
  for (;;) {
    // Weights, of any sign, of the point nearest to the origin in the plane of all corners.
    nsvcd__d3 edges[3];
    double target[4] = {1};
    if (!nsvcd__solve_shares(s->points, s->count, 0, edges, target + 1)) return 0;
    for (size_t i = 1; i < s->count; i++) target[0] -= target[i];
    double way = 1;
    size_t blocks = s->count;
    for (size_t i = 0; i < s->count; i++) {
      const double weight = s->weights[i];
      if (target[i] > 0) continue;
      const double to_zero = weight > 0 ? weight / (weight - target[i]) : 0;
      if (to_zero > way) continue;
      way = to_zero;
      blocks = i;
    }
    for (size_t i = 0; i < s->count; i++) s->weights[i] += way * (target[i] - s->weights[i]);
    if (blocks == s->count) return 1;
    s->count--;
    s->points[blocks] = s->points[s->count];
    s->weights[blocks] = s->weights[s->count];
  }
}

// The distance of a point from some point of the convex hull of vertices: no less than that from
// the hull, and no more than two thousandths above it, but for roundings or where it is below
// `enough`. Ten steps or so do; on x87, whose registers have more digits than memory, they may seem
// to get nearer for ever.
static double nsvcd__hull_distance(nsvcd__points hull, nsvcd__d3 point, double enough) {
  nsvcd__simplex s;
  s.points[0] = nsvcd__d3_sub(hull.at[hull.count - 1], point);
  s.weights[0] = 1;
  s.count = 1;
  nsvcd__d3 nearest = s.points[0];
  double best = nsvcd__d3_dot(nearest, nearest);
  for (int step = 0; step < 64 && best > enough * enough && s.count < 4; step++) {
    const double offset = nsvcd__d3_dot(point, nearest);
    double least = HUGE_VAL;
    size_t support = 0;
    for (size_t i = 0; i < hull.count; i++) {
      const double at = nsvcd__d3_dot(hull.at[i], nearest) - offset;
      if (at < least) support = i;
      least = at < least ? at : least;
    }
    if (least >= 0.998 * best) break;
    s.points[s.count] = nsvcd__d3_sub(hull.at[support], point);
    s.weights[s.count++] = 0;
    const int settled = nsvcd__simplex_settle(&s);
    nearest = nsvcd__d3_scale(s.points[0], s.weights[0]);
    for (size_t i = 1; i < s.count; i++)
      nearest = nsvcd__d3_fma(s.weights[i], s.points[i], nearest);
    const double squared = nsvcd__d3_dot(nearest, nearest);
    if (!settled || squared >= best) break;
    best = squared;
  }
  return sqrt(best);
}

// Chooses up to NSVCD__HULL of the points such that all are near to the hull of those: all, if they
// are not more, or else always the one that is farthest from it. points: about the ball's centre.
// bounds: working memory, one a point: their distances found before. A point that was near enough
// stays so, for the hull only grows. Writes the numbers of those chosen, and the distance of the
// farthest point; returns how many they are.
static size_t nsvcd__choose_hull(nsvcd__points points, double enough, double *bounds,
                                 size_t *chosen, double *farthest) {
  nsvcd__d3 at[NSVCD__HULL];
  nsvcd__points hull = {at, 0};
  size_t next = 0;
  double most = 0;
  *farthest = 0;
  if (points.count <= NSVCD__HULL) {
    for (size_t i = 0; i < points.count; i++) chosen[i] = i;
    return points.count;
  }
  for (size_t i = 0; i < points.count; i++) {
    // from the centre, to begin with
    const double distance = nsvcd__d3_length(points.at[i]);
    if (distance > most) next = i;
    most = nsvcd__max(most, distance);
    bounds[i] = HUGE_VAL;
  }
  *farthest = HUGE_VAL;
  while (hull.count<NSVCD__HULL && * farthest> enough) {
    at[hull.count] = points.at[next];
    chosen[hull.count++] = next;
    bounds[next] = 0;
    size_t first = 0;
    for (size_t i = 1; i < points.count; i++) first = bounds[i] > bounds[first] ? i : first;
    *farthest = 0;
    for (size_t k = 0; k < points.count; k++) {
      const size_t i = (first + k) % points.count;
      if (bounds[i] <= *farthest) continue;
      bounds[i] = nsvcd__min(bounds[i], nsvcd__hull_distance(hull, points.at[i], *farthest));
      if (bounds[i] <= *farthest) continue;
      *farthest = bounds[i];
      next = i;
    }
  }
  return hull.count;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF

// --------------------------------------------------------------------------------- surface/surface
// In: pieces, sorted by patch. Out: nsvcd__surface: of each patch a ball, a disc, a hull, its
// triangles, all rounded outwards.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
// The pieces by patch, and working memory for one patch at a time. A pass numbers points as it sees
// them: the hull's first, when vertices are stored.
typedef struct nsvcd__sorted {
  const nsvcd__pieces *pieces;
  size_t *first;  // (N + 1) pieces of a patch
  // (pieces) numbers of pieces, patch by patch, in a patch as they were made
  uint32_t *order;
  uint32_t pass;  // from 1
  // (points) the last pass that met a point, and its number in that pass
  uint32_t *stamps;
  uint32_t *numbers;
  // (met_count) the points of the pass
  uint32_t *met;
  size_t met_count;
  nsvcd__d3 *places;  // the same, about the centre
  double *bounds;     // of the same
  // (N, NSVCD__HULL) points that the hulls consist of
  uint32_t *hulls;
} nsvcd__sorted;

static const nsvcd__piece *nsvcd__sorted_piece(const nsvcd__sorted *sorted, size_t k) {
  return (const nsvcd__piece *)sorted->pieces->list.items + sorted->order[k];
}

// Sorts the pieces by patch (counting sort). 0 without memory.
static int nsvcd__sorted_build(const nsvcd__pieces *pieces, nsvcd__arena *arena,
                               nsvcd__sorted *sorted) {
  const nsvcd__piece *items = (const nsvcd__piece *)pieces->list.items;
  const size_t patches = pieces->patches->count;
  const size_t count = pieces->list.count;
  const size_t points = pieces->region->mesh.vertex_count + pieces->points.count;
  size_t *first = NSVCD__TAKE(arena, size_t, patches + 1);
  memset(sorted, 0, sizeof *sorted);
  sorted->pieces = pieces;
  sorted->first = first;
  sorted->order = NSVCD__TAKE(arena, uint32_t, count);
  sorted->stamps = NSVCD__TAKE(arena, uint32_t, points);
  sorted->numbers = NSVCD__TAKE(arena, uint32_t, points);
  sorted->hulls = NSVCD__TAKE(arena, uint32_t, NSVCD__HULL * patches);
  if (arena->failed) return 0;
  for (size_t k = 0; k < count; k++) first[items[k].patch + 1]++;
  for (size_t i = 0; i < patches; i++) first[i + 1] += first[i];
  for (size_t k = count; k-- > 0;) sorted->order[--first[items[k].patch + 1]] = (uint32_t)k;
  // Now first[i + 1] is the start of patch i.
  memmove(first, first + 1, patches * sizeof *first);
  first[patches] = count;

  size_t most = 0;
  for (size_t i = 0; i < patches; i++) {
    // a hull's vertices need not be corners of what is listed
    size_t corners = NSVCD__HULL;
    for (size_t k = first[i]; k < first[i + 1]; k++)
      corners += nsvcd__sorted_piece(sorted, k)->count;
    most = corners > most ? corners : most;
  }
  sorted->met = NSVCD__TAKE(arena, uint32_t, most);
  sorted->places = NSVCD__TAKE(arena, nsvcd__d3, most);
  sorted->bounds = NSVCD__TAKE(arena, double, most);
  return !arena->failed;
}

// Gives a point a number in this pass, if it is met for the first time.
static void nsvcd__number_point(nsvcd__sorted *sorted, uint32_t point) {
  if (sorted->stamps[point] == sorted->pass) return;
  sorted->stamps[point] = sorted->pass;
  sorted->numbers[point] = (uint32_t)sorted->met_count;
  sorted->met[sorted->met_count++] = point;
}

// The points of the pass, about a centre.
static nsvcd__points nsvcd__place_points(nsvcd__sorted *sorted, nsvcd__d3 centre) {
  const nsvcd__points out = {sorted->places, sorted->met_count};
  for (size_t j = 0; j < sorted->met_count; j++) {
    const nsvcd__d3 at = nsvcd__point_at(sorted->pieces, sorted->met[j]);
    sorted->places[j] = nsvcd__d3_sub(at, centre);
  }
  return out;
}

// Ball, disc and hull of patch i of the region, which is `to` of all. What the vertices will be off
// by as integers is not in the slack yet.
static void nsvcd__describe_patch(nsvcd__sorted *sorted, size_t i, nsvcd__surface *s) {
  const nsvcd__pieces *pieces = sorted->pieces;
  const nsvcd__region *region = pieces->region;
  const size_t to = s->done + i;
  nsvcd__sphere *ball = &s->balls[to];
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  sorted->pass++;
  sorted->met_count = 0;
  for (size_t k = sorted->first[i]; k < sorted->first[i + 1]; k++) {
    const nsvcd__piece *piece = nsvcd__sorted_piece(sorted, k);
    const uint32_t *corners = nsvcd__piece_corners(pieces, piece);
    const nsvcd__d3 from = nsvcd__point_at(pieces, corners[0]);
    // twice the area times the normal
    nsvcd__d3 area = nsvcd__d3_of(0, 0, 0);
    // a point has no area, and is met once
    const int is_point = corners[0] == corners[1] && corners[1] == corners[2];
    for (size_t j = 0; j < piece->count && (j == 0 || !is_point); j++) {
      const uint32_t point = corners[j];
      nsvcd__number_point(sorted, point);
      // of a component that no patch has been given yet?
      if (point < region->mesh.vertex_count && region->seeds[point]) {
        region->seeds[point] = 0;
        s->seeds[s->seed_count] = nsvcd__f3_row(region->mesh.positions, point);
        s->seed_patches[s->seed_count++] = (uint32_t)to;
      }
      if (j < 2) continue;
      const nsvcd__d3 a = nsvcd__d3_sub(nsvcd__point_at(pieces, corners[j - 1]), from);
      const nsvcd__d3 b = nsvcd__d3_sub(nsvcd__point_at(pieces, point), from);
      area = nsvcd__d3_add(area, nsvcd__d3_cross(a, b));
    }
    normal = nsvcd__d3_add(normal, area);
  }
  if (sorted->met_count == 0) {
    ball->centre = pieces->patches->centres[i];
    ball->radius = NSVCD__NOWHERE;
    return;
  }

  // The least ball. From near by its centre is found without the roundings of what is far away.
  const nsvcd__d3 from = nsvcd__point_at(pieces, sorted->met[0]);
  const nsvcd__d3 offset = nsvcd__ball_centre(nsvcd__place_points(sorted, from));
  ball->centre = nsvcd__f3_round(nsvcd__d3_add(from, offset));
  const nsvcd__points about = nsvcd__place_points(sorted, nsvcd__d3_widen(ball->centre));
  double radius = 0;
  for (size_t j = 0; j < about.count; j++)
    radius = nsvcd__max(radius, nsvcd__d3_length(about.at[j]));
  ball->radius = nsvcd__float_above(radius + pieces->margin);
  s->discs[to] = nsvcd__fit_disc(about, normal, pieces->margin, pieces->thin);

  size_t chosen[NSVCD__HULL];
  double farthest;
  const double enough = NSVCD__HULL_SHARE * (double)ball->radius;
  const size_t count = nsvcd__choose_hull(about, enough, sorted->bounds, chosen, &farthest);
  s->slacks[to] = nsvcd__float_above(farthest + pieces->margin);
  s->hull_counts[to] = (uint8_t)count;
  for (size_t k = 0; k < count; k++)
    sorted->hulls[NSVCD__HULL * i + k] = sorted->met[chosen[k]];
}

// What patch i lists for its k-th piece: the piece's corners where its triangle is parted, else the
// triangle's. Returns how many corners; 0: nothing more, for pieces of one triangle follow each
// other in a patch, and a whole triangle is listed with the first of them.
static size_t nsvcd__listed_corners(const nsvcd__sorted *sorted, size_t i, size_t k,
                                    const uint32_t **corners) {
  const nsvcd__piece *piece = nsvcd__sorted_piece(sorted, k);
  *corners = nsvcd__piece_corners(sorted->pieces, piece);
  if (piece->parted) return piece->count;
  *corners = nsvcd__triangle_corners(sorted->pieces, piece->triangle);
  const int first = k == sorted->first[i];
  return first || nsvcd__sorted_piece(sorted, k - 1)->triangle != piece->triangle ? 3 : 0;
}

// Numbers the vertices of patch i: the hull's, then others of what it lists. Returns how many
// triangles it lists.
static size_t nsvcd__number_vertices(nsvcd__sorted *sorted, size_t i, size_t hull_count) {
  size_t listed = 0;
  sorted->pass++;
  sorted->met_count = 0;
  for (size_t k = 0; k < hull_count; k++)
    nsvcd__number_point(sorted, sorted->hulls[NSVCD__HULL * i + k]);
  for (size_t k = sorted->first[i]; k < sorted->first[i + 1]; k++) {
    const uint32_t *corners;
    const size_t count = nsvcd__listed_corners(sorted, i, k, &corners);
    for (size_t j = 0; j < count; j++) nsvcd__number_point(sorted, corners[j]);
    listed += count ? count - 2 : 0;
  }
  return listed;
}

// Writes the vertices of patch i as integers, and its triangles.
static void nsvcd__store_patch(nsvcd__sorted *sorted, size_t i, nsvcd__surface *s) {
  const size_t to = s->done + i;
  const size_t hull_count = s->hull_counts[to];
  (void)nsvcd__number_vertices(sorted, i, hull_count);
  const nsvcd__d3 centre = nsvcd__d3_widen(s->balls[to].centre);
  const nsvcd__points points = nsvcd__place_points(sorted, centre);
  double greatest = NSVCD__SURFACE_TINY;
  for (size_t j = 0; j < points.count; j++) {
    for (size_t k = 0; k < 3; k++)
      greatest = nsvcd__max(greatest, fabs(nsvcd__d3_axis(points.at[j], k)));
  }
  s->steps[to] = nsvcd__float_above(greatest / 32767);
  const double metres = (double)s->steps[to];
  int16_t *vertices = s->vertices + 3 * (size_t)s->first_vertex[to];
  double worst = 0;
  double worst_of_hull = 0;
  for (size_t j = 0; j < points.count; j++) {
    nsvcd__d3 stored = {0, 0, 0};
    for (size_t k = 0; k < 3; k++) {
      const double nearest = floor(nsvcd__d3_axis(points.at[j], k) / metres + 0.5);
      const double integer = nsvcd__min(nsvcd__max(nearest, -32767), 32767);
      vertices[k * points.count + j] = (int16_t)integer;
      nsvcd__d3_set_axis(&stored, k, metres * integer);
    }
    worst = nsvcd__max(worst, nsvcd__d3_length(nsvcd__d3_sub(points.at[j], stored)));
    if (j < hull_count) worst_of_hull = worst;
  }
  s->quanta[to] = nsvcd__float_above(worst + sorted->pieces->margin);
  // Each point of the hull is off by no more than its vertices are.
  const double slack = (double)s->slacks[to] + worst_of_hull;
  s->slacks[to] = nsvcd__float_above(slack);

  for (size_t k = sorted->first[i]; k < sorted->first[i + 1]; k++) {
    const uint32_t triangle = nsvcd__sorted_piece(sorted, k)->triangle;
    const uint32_t *corners;
    const size_t count = nsvcd__listed_corners(sorted, i, k, &corners);
    for (size_t j = 2; j < count; j++) {
      uint16_t *out = s->corners + 3 * s->listed;
      out[0] = (uint16_t)sorted->numbers[corners[0]];
      out[1] = (uint16_t)sorted->numbers[corners[j - 1]];
      out[2] = (uint16_t)sorted->numbers[corners[j]];
      s->ids[s->listed++] = sorted->pieces->region->ids[triangle];
    }
  }
}

// ---- all of it

// A surface of up to n patches, none of which is described yet. 0 without memory.
static int nsvcd__surface_begin(size_t n, size_t components, nsvcd__arena *arena,
                                nsvcd__surface *s) {
  memset(s, 0, sizeof *s);
  s->arena = arena;
  s->component_count = components;
  s->balls = NSVCD__TAKE(arena, nsvcd__sphere, n);
  s->discs = NSVCD__TAKE(arena, nsvcd__disc, n);
  s->steps = NSVCD__TAKE(arena, float, n);
  s->slacks = NSVCD__TAKE(arena, float, n);
  s->quanta = NSVCD__TAKE(arena, float, n);
  s->hull_counts = NSVCD__TAKE(arena, uint8_t, n);
  s->first_vertex = NSVCD__TAKE(arena, uint32_t, n + 1);
  s->first_triangle = NSVCD__TAKE(arena, uint32_t, n + 1);
  s->seeds = NSVCD__TAKE(arena, nsvcd__f3, components);
  s->seed_patches = NSVCD__TAKE(arena, uint32_t, components);
  return !arena->failed;
}

// Makes room for more vertices and listings. 0 without memory.
static int nsvcd__surface_room(nsvcd__surface *s, size_t vertices, size_t triangles) {
  nsvcd__list *lists[] = {&s->vertex_list, &s->corner_list, &s->id_list};
  for (size_t k = 0; k < 3; k++) {
    const size_t more = k == 0 ? vertices : triangles;
    const size_t size = k < 2 ? 3 * sizeof(int16_t) : sizeof(uint32_t);
    lists[k]->count = k == 0 ? s->vertex_count : s->listed;
    if (!nsvcd__list_reserve(lists[k], more, size, s->arena)) return 0;
  }
  s->vertices = (int16_t *)s->vertex_list.items;
  s->corners = (uint16_t *)s->corner_list.items;
  s->ids = (uint32_t *)s->id_list.items;
  return 1;
}

// Adds the patches of a region, in pieces, of which the surface has room for all: describes each,
// counts its vertices and triangles, makes room for these, and writes them. spare: of what is only
// needed meanwhile. MEMORY; TOO_LARGE if a patch has more than NSVCD__PATCH_VERTICES vertices, or
// all have too many: then the surface is of no use any more.
static nsvcd_result nsvcd__surface_add(const nsvcd__pieces *pieces, nsvcd__arena *spare,
                                       nsvcd__surface *s) {
  nsvcd__sorted sorted;
  if (!nsvcd__sorted_build(pieces, spare, &sorted)) return NSVCD_ERROR_MEMORY;
  const size_t done = s->done;
  size_t vertices = s->vertex_count;
  size_t triangles = s->listed;
  s->count = done + pieces->patches->count;
  for (size_t i = done; i < s->count; i++) {
    nsvcd__describe_patch(&sorted, i - done, s);
    s->first_vertex[i] = (uint32_t)vertices;
    s->first_triangle[i] = (uint32_t)triangles;
    // Where nothing is cut, and all points are the hull's, they have been counted.
    if (pieces->corners.count == 0 && sorted.met_count == s->hull_counts[i])
      triangles += sorted.first[i - done + 1] - sorted.first[i - done];
    else
      triangles += nsvcd__number_vertices(&sorted, i - done, s->hull_counts[i]);
    vertices += sorted.met_count;
    if (sorted.met_count > NSVCD__PATCH_VERTICES) return NSVCD_ERROR_TOO_LARGE;
    if (vertices > NSVCD__MAX_COUNT || triangles > NSVCD__MAX_COUNT)
      return NSVCD_ERROR_TOO_LARGE;
  }
  s->first_vertex[s->count] = (uint32_t)vertices;
  s->first_triangle[s->count] = (uint32_t)triangles;
  if (!nsvcd__surface_room(s, vertices - s->vertex_count, triangles - s->listed))
    return NSVCD_ERROR_MEMORY;
  s->vertex_count = vertices;
  for (size_t i = done; i < s->count; i++) {
    if (s->hull_counts[i] > 0) nsvcd__store_patch(&sorted, i - done, s);
  }
  s->done = s->count;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER, NSVCD_NO_PROOF

// ====================================================== encoder: what the network keeps of a patch

// ----------------------------------------------------------------------------------- encoder/model
// In: weights.h, which train/ generates. Out: its arrays: matrices are (inputs, outputs).

#ifndef NSVCD_NO_NETWORK
// A decoder: `layers` linear layers with ReLU between them, sizes multiples of 4 and, but for the
// inputs, of 16. Offsets instead of pointers: nothing needs relocation, so that all of it stays in
// read-only memory.
typedef struct nsvcd__decoder {
  // 0: compiled out
  size_t layers;
  // (layers + 1)
  size_t sizes[6];
  // of its matrices: per layer (sizes[l], sizes[l + 1]) floats in nsvcd_w_decoder, and the same
  // numbers in nsvcd_w_decoder_int8 as (sizes[l] / 4, sizes[l + 1], 4), over the output's scale
  size_t weights;
  // of its outputs: per layer (sizes[l + 1]) in nsvcd_w_decoder_bias, _scale and _sum (of the int8)
  size_t outputs;
} nsvcd__decoder;

#include "weights.h"

#define NSVCD__LATENT (8 * NSVCD_W_CHANNELS + NSVCD_W_SCALARS)
#endif  // NSVCD_NO_NETWORK

// --------------------------------------------------------------------------------- encoder/encoder
// In: the samples of one patch, its centre and the radius of its ball. Out: its latent
// (NSVCD__LATENT floats in (-1,1)): NSVCD_W_CHANNELS vectors of degree 1, as many of degree 2,
// NSVCD_W_SCALARS invariants.
//
// A Vector-Neuron encoder (Deng et al. 2021) on features of degrees 1 and 2 (FER-VN, Son et al.
// 2024): channels are mixed by matrices shared by all components, and the only nonlinearities are
// gates computed from invariants, so turning the samples by R turns the latent by D(R). Dividing by
// the radius makes it independent of scale.

#ifndef NSVCD_NO_NETWORK
#ifndef NSVCD_NO_ENCODER
// channels after pooling
#define NSVCD__WIDE (NSVCD_W_POOLED + NSVCD_W_CONTEXT)
// of each sample
#define NSVCD__INVARIANTS (2 + 5 * NSVCD_W_CONTEXT)
#define NSVCD__GATES (5 * NSVCD_W_POOLED + NSVCD_W_POOLED_SCALARS)
#define NSVCD__PATCH_IN (2 * NSVCD__WIDE + NSVCD_W_POOLED_SCALARS)
#define NSVCD__PATCH_OUT (2 * NSVCD_W_HIDDEN + NSVCD_W_SCALARS)

// A linear layer: y = w^T x + bias; w (inputs, outputs), bias (outputs) or NULL, x (inputs),
// y (outputs), apart from each other. It is a sum of rows, which compilers vectorise.
static void nsvcd__linear(const float *w, const float *bias, size_t inputs, size_t outputs,
                          const float *x, float *y) {
  size_t left = inputs;
  for (size_t o = 0; o < outputs; o++) y[o] = bias ? bias[o] : 0;
  // four rows at a time: reading and writing y takes longest
  for (; left >= 4; left -= 4) {
    const float *r1 = w + outputs;
    const float *r2 = r1 + outputs;
    const float *r3 = r2 + outputs;
    const float x0 = x[0];
    const float x1 = x[1];
    const float x2 = x[2];
    const float x3 = x[3];
    for (size_t o = 0; o < outputs; o++)
      y[o] += (w[o] * x0 + r1[o] * x1) + (r2[o] * x2 + r3[o] * x3);
    w += 4 * outputs;
    x += 4;
  }
  for (; left > 0; left--) {
    for (size_t o = 0; o < outputs; o++) y[o] += w[o] * x[0];
    w += outputs;
    x++;
  }
}

static void nsvcd__relu(size_t count, float *x) {
  for (size_t i = 0; i < count; i++) x[i] = x[i] > 0 ? x[i] : 0;
}

// A vector of degree 2, in the basis of the real spherical harmonics xy, yz, zz, xz, xx-yy.
typedef struct nsvcd__f5 {
  float v[5];
} nsvcd__f5;

// Written out, for compilers that leave a loop over five in memory.
static inline nsvcd__f5 nsvcd__f5_scale(nsvcd__f5 a, float s) {
  const float *v = a.v;
  const nsvcd__f5 out = {{s * v[0], s * v[1], s * v[2], s * v[3], s * v[4]}};
  return out;
}
static inline nsvcd__f5 nsvcd__f5_add(nsvcd__f5 a, nsvcd__f5 b) {
  nsvcd__f5 out;
  out.v[0] = a.v[0] + b.v[0];
  out.v[1] = a.v[1] + b.v[1];
  out.v[2] = a.v[2] + b.v[2];
  out.v[3] = a.v[3] + b.v[3];
  out.v[4] = a.v[4] + b.v[4];
  return out;
}
static inline float nsvcd__f5_dot(nsvcd__f5 a, nsvcd__f5 b) {
  float sum = a.v[0] * b.v[0];
  sum += a.v[1] * b.v[1];
  sum += a.v[2] * b.v[2];
  sum += a.v[3] * b.v[3];
  return sum + a.v[4] * b.v[4];
}

// The symmetric traceless part of a b^T, scaled so that the square of a vector has its squared
// length.
static nsvcd__f5 nsvcd__degree2(nsvcd__f3 a, nsvcd__f3 b) {
  const float half_root3 = 0.8660254037844386f;
  nsvcd__f5 q;
  q.v[0] = half_root3 * (a.x * b.y + a.y * b.x);
  q.v[1] = half_root3 * (a.y * b.z + a.z * b.y);
  q.v[2] = a.z * b.z - 0.5f * (a.x * b.x + a.y * b.y);
  q.v[3] = half_root3 * (a.x * b.z + a.z * b.x);
  q.v[4] = half_root3 * (a.x * b.x - a.y * b.y);
  return q;
}

// The samples of a patch, in its frame.
typedef struct nsvcd__encoded {
  // (count)
  const nsvcd__f3 *samples;
  // (count)
  const nsvcd__f3 *normals;
  size_t count;
  nsvcd__f3 centre;
  float inverse_radius;
} nsvcd__encoded;

// One sample: its vectors of degree 1 and 2.
typedef struct nsvcd__feature {
  // place over the radius; unit normal
  nsvcd__f3 u, n;
  float uu, un;  // |u|^2, u.n
  // degree2 of both
  nsvcd__f5 quu, qun, qnn;
} nsvcd__feature;

static nsvcd__feature nsvcd__feature_of(const nsvcd__encoded *patch, size_t i) {
  const nsvcd__f3 offset = nsvcd__f3_sub(patch->samples[i], patch->centre);
  nsvcd__feature f;
  f.u = nsvcd__f3_scale(offset, patch->inverse_radius);
  f.n = patch->normals[i];
  f.uu = nsvcd__f3_dot(f.u, f.u);
  f.un = nsvcd__f3_dot(f.u, f.n);
  f.quu = nsvcd__degree2(f.u, f.u);
  f.qun = nsvcd__degree2(f.u, f.n);
  f.qnn = nsvcd__degree2(f.n, f.n);
  return f;
}

// The channels of a patch: what is pooled, then the context.
typedef struct nsvcd__channels {
  nsvcd__f3 degree1[NSVCD__WIDE];
  nsvcd__f5 degree2[NSVCD__WIDE];
  float scalars[NSVCD_W_POOLED_SCALARS];
} nsvcd__channels;

// First pass: four moments of each degree, mixed into the context.
static void nsvcd__context(const nsvcd__encoded *patch, nsvcd__channels *out) {
  nsvcd__f3 m1[4] = {{0, 0, 0}};
  nsvcd__f5 m2[4] = {{{0, 0, 0, 0, 0}}};
  for (size_t i = 0; i < patch->count; i++) {
    const nsvcd__feature f = nsvcd__feature_of(patch, i);
    m1[0] = nsvcd__f3_add(m1[0], f.n);
    m1[1] = nsvcd__f3_fma(f.uu, f.n, m1[1]);
    m1[2] = nsvcd__f3_fma(f.un, f.u, m1[2]);
    m1[3] = nsvcd__f3_fma(f.uu, f.u, m1[3]);
    m2[0] = nsvcd__f5_add(m2[0], f.quu);
    m2[1] = nsvcd__f5_add(m2[1], f.qun);
    m2[2] = nsvcd__f5_add(m2[2], f.qnn);
    m2[3] = nsvcd__f5_add(m2[3], nsvcd__f5_scale(f.qun, f.un));
  }
  const float share = 1 / (float)patch->count;
  for (size_t c = 0; c < NSVCD_W_CONTEXT; c++) {
    nsvcd__f3 c1 = {0, 0, 0};
    nsvcd__f5 c2 = {{0, 0, 0, 0, 0}};
    for (size_t m = 0; m < 4; m++) {
      const float w1 = nsvcd_w_context1[m * NSVCD_W_CONTEXT + c];
      const float w2 = nsvcd_w_context2[m * NSVCD_W_CONTEXT + c];
      c1 = nsvcd__f3_fma(share, nsvcd__f3_scale(m1[m], w1), c1);
      c2 = nsvcd__f5_add(c2, nsvcd__f5_scale(nsvcd__f5_scale(m2[m], w2), share));
    }
    out->degree1[NSVCD_W_POOLED + c] = c1;
    out->degree2[NSVCD_W_POOLED + c] = c2;
  }
}

// The sample network: invariants of one sample -> its gates, (5 POOLED + POOLED_SCALARS).
static void nsvcd__gates(const nsvcd__feature *f, const nsvcd__channels *context,
                         float *gates) {
  const size_t hidden = NSVCD_W_POINT_HIDDEN;
  const nsvcd__f3 *c1 = context->degree1 + NSVCD_W_POOLED;
  const nsvcd__f5 *c2 = context->degree2 + NSVCD_W_POOLED;
  float x[NSVCD__INVARIANTS], h1[NSVCD_W_POINT_HIDDEN], h2[NSVCD_W_POINT_HIDDEN];
  x[0] = f->uu;
  x[1] = f->un;
  for (size_t c = 0; c < NSVCD_W_CONTEXT; c++) {
    float *to = x + 2 + c;
    to[0] = nsvcd__f3_dot(f->u, c1[c]);
    to[NSVCD_W_CONTEXT] = nsvcd__f3_dot(f->n, c1[c]);
    to[2 * NSVCD_W_CONTEXT] = nsvcd__f5_dot(f->quu, c2[c]);
    to[3 * NSVCD_W_CONTEXT] = nsvcd__f5_dot(f->qun, c2[c]);
    to[4 * NSVCD_W_CONTEXT] = nsvcd__f5_dot(f->qnn, c2[c]);
  }
  nsvcd__linear(nsvcd_w_point0, nsvcd_w_point0_bias, NSVCD__INVARIANTS, hidden, x, h1);
  nsvcd__relu(hidden, h1);
  nsvcd__linear(nsvcd_w_point1, nsvcd_w_point1_bias, hidden, hidden, h1, h2);
  nsvcd__relu(hidden, h2);
  nsvcd__linear(nsvcd_w_point2, nsvcd_w_point2_bias, hidden, NSVCD__GATES, h2, gates);
}

// The patch network: the channels -> the latent. Of each degree the channels are mixed, gated and
// mixed once more.
static void nsvcd__finish_latent(const nsvcd__channels *a, float *latent) {
  const size_t hidden = NSVCD_W_PATCH_HIDDEN;
  float x[NSVCD__PATCH_IN], h[NSVCD_W_PATCH_HIDDEN], y[NSVCD__PATCH_OUT];
  for (size_t c = 0; c < NSVCD__WIDE; c++) {
    x[c] = nsvcd__f3_dot(a->degree1[c], a->degree1[c]);
    x[NSVCD__WIDE + c] = nsvcd__f5_dot(a->degree2[c], a->degree2[c]);
  }
  memcpy(x + 2 * NSVCD__WIDE, a->scalars, sizeof a->scalars);
  nsvcd__linear(nsvcd_w_patch0, nsvcd_w_patch0_bias, NSVCD__PATCH_IN, hidden, x, h);
  nsvcd__relu(hidden, h);
  nsvcd__linear(nsvcd_w_patch1, nsvcd_w_patch1_bias, hidden, NSVCD__PATCH_OUT, h, y);

  for (size_t degree = 1; degree <= 2; degree++) {
    const void *channels = degree == 1 ? (const void *)a->degree1 : (const void *)a->degree2;
    // (WIDE, size)
    const float *from = (const float *)channels;
    const float *mix = degree == 1 ? nsvcd_w_mix1 : nsvcd_w_mix2;
    const float *out = degree == 1 ? nsvcd_w_out1 : nsvcd_w_out2;
    const float *gates = y + NSVCD_W_HIDDEN * (degree - 1);
    const size_t size = 2 * degree + 1;
    for (size_t k = 0; k < size; k++) {
      float mixed[NSVCD__WIDE], gated[NSVCD_W_HIDDEN];
      for (size_t c = 0; c < NSVCD__WIDE; c++) mixed[c] = from[c * size + k];
      nsvcd__linear(mix, NULL, NSVCD__WIDE, NSVCD_W_HIDDEN, mixed, gated);
      for (size_t c = 0; c < NSVCD_W_HIDDEN; c++) gated[c] *= gates[c];
      float *z = latent + NSVCD_W_CHANNELS * k;
      nsvcd__linear(out, NULL, NSVCD_W_HIDDEN, NSVCD_W_CHANNELS, gated, z);
    }
    // shortened to less than 1, so that int8 holds it
    for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
      float *z = latent + c;
      float square = 0;
      for (size_t k = 0; k < size; k++)
        square += z[NSVCD_W_CHANNELS * k] * z[NSVCD_W_CHANNELS * k];
      const float scale = 1 / sqrtf(1 + square);
      for (size_t k = 0; k < size; k++) z[NSVCD_W_CHANNELS * k] *= scale;
    }
    latent += NSVCD_W_CHANNELS * size;
  }
  const float *scalars = y + 2 * NSVCD_W_HIDDEN;
  for (size_t c = 0; c < NSVCD_W_SCALARS; c++) latent[c] = tanhf(scalars[c]);
}

// The latent (LATENT) of a patch of one sample or more: degree 1 (3, CHANNELS), degree 2 (5,
// CHANNELS), scalars.
static void nsvcd__encode_patch(const nsvcd__encoded *patch, float *latent) {
  const size_t pooled = NSVCD_W_POOLED;
  const float share = 1 / (float)patch->count;
  nsvcd__channels all;
  memset(&all, 0, sizeof all);
  nsvcd__context(patch, &all);
  for (size_t i = 0; i < patch->count; i++) {
    const nsvcd__feature f = nsvcd__feature_of(patch, i);
    float gates[NSVCD__GATES];
    nsvcd__gates(&f, &all, gates);
    for (size_t c = 0; c < pooled; c++) {
      const float *gate = gates + c;
      nsvcd__f3 a1 = nsvcd__f3_scale(f.u, gate[0]);
      a1 = nsvcd__f3_add(a1, nsvcd__f3_scale(f.n, gate[pooled]));
      nsvcd__f5 a2 = nsvcd__f5_scale(f.quu, gate[2 * pooled]);
      a2 = nsvcd__f5_add(a2, nsvcd__f5_scale(f.qun, gate[3 * pooled]));
      a2 = nsvcd__f5_add(a2, nsvcd__f5_scale(f.qnn, gate[4 * pooled]));
      all.degree1[c] = nsvcd__f3_fma(share, a1, all.degree1[c]);
      all.degree2[c] = nsvcd__f5_add(all.degree2[c], nsvcd__f5_scale(a2, share));
    }
    for (size_t c = 0; c < NSVCD_W_POOLED_SCALARS; c++)
      all.scalars[c] += gates[5 * pooled + c] * share;
  }
  nsvcd__finish_latent(&all, latent);
}
#endif  // NSVCD_NO_ENCODER
#endif  // NSVCD_NO_NETWORK

// ================================================================================== body: the blob

// --------------------------------------------------------------------------------------- body/body
// In: N patches. Out: one relocatable, checksummed blob. Patches are stored in groups of 16
// neighbours, each group with a sphere over its members. Where there are many groups, there are
// levels of spheres above them: the broad phase's tree. There are two kinds of bodies, which begin
// alike:
//
//   struct nsvcd_body    64 bytes
//   x, y, z, r   (4, P)  float: spheres of the patches, body frame, metres; P = N rounded up to 16;
//                        padding has r = NSVCD__NOWHERE
//   x, y, z, r   (4, G)  float: spheres of the groups; G = P / 16 rounded up to 16, padding as
//                        above. In a body of latents they are over the patches' spheres; in one
//                        of triangles over the surface in them, which may be much less
//   x, y, z, r   (4, H)  float: if there are more than 32 groups, spheres over 16 groups each;
//                        H as G
//   x, y, z, r   (4, I)  float: if these are more than 16, spheres over 16 of them each
//
// A body of latents, for the network, goes on with
//   x, y, z      (3, P)  float: area vectors, square metres, along the outward normal; padding is
//                        zero
//   x, y, z      (3, G), (3, H), (3, I)  float: if there are more than 32 groups, their sums over
//                        the members of the spheres above
//   latents      (N, NSVCD__LATENT)  int8, free of scale
// and a body of triangles, for the proof, with what body/facets says. A body that has both is
// one of latents with one of triangles behind it, at `inner`: each part has spheres that suit it,
// and patches have the same numbers in both. Each part ends in zeros up to a multiple of
// NSVCD_ALIGNMENT.

// patches of a group, and groups or the like of a sphere above
#define NSVCD__GROUP NSVCD__LANES
// Groups of a body that are searched at once; with more there are levels above. (Fewer for a test,
// in which small bodies then make several tiles.)
#ifndef NSVCD__TILE
#define NSVCD__TILE 32
#endif
#define NSVCD__TILE_SLOTS 32
#define NSVCD__LEVELS 3  // of spheres above the patches, at most
// metres, over every radius and distance that coordinates within bounds can give
#define NSVCD__MAX_LENGTH 1.6e7f
#define NSVCD__BODY_MAGIC 0x4256534eu  // "NSVB", or "BVSN": the mark of the byte order
#define NSVCD__BODY_VERSION 6u

struct nsvcd_body {
  uint32_t magic, version;
  // over everything that follows
  uint64_t checksum;
  // bytes, of the whole blob
  uint32_t size;
  // of the weights that made the latents; 0: a body of triangles
  uint32_t weights_id;
  uint32_t patches;  // N
  uint32_t padded;   // P
  // a sphere over all
  float centre[3], radius;
  // max |p_i| + r_i: no part is farther from the body's origin
  float extent;
  // 1: nothing can be inside
  uint32_t open;
  // of the mesh; 0: none are stored
  uint32_t triangles;
  // bytes from here to the body of triangles within; 0: there is none
  uint32_t inner;
};

static size_t nsvcd__group_slots(size_t padded) {
  return nsvcd__round_up(padded / NSVCD__GROUP, NSVCD__GROUP);
}

// A level of spheres: level 0 are the groups, each of the next is over 16 of the one before.
typedef struct nsvcd__level {
  size_t count;  // spheres
  size_t slots;  // the same, rounded up to 16
  // float, from the body's first: x (slots), y, z, r
  size_t first;
} nsvcd__level;

static nsvcd__level nsvcd__level_of(size_t padded, size_t level) {
  nsvcd__level out = {padded / NSVCD__GROUP, nsvcd__group_slots(padded), 4 * padded};
  for (; level > 0; level--) {
    out.first += 4 * out.slots;
    out.count = nsvcd__round_up(out.count, NSVCD__GROUP) / NSVCD__GROUP;
    out.slots = nsvcd__round_up(out.count, NSVCD__GROUP);
  }
  return out;
}

// How many levels there are: none above the groups where these can be searched all at once.
static size_t nsvcd__level_count(size_t padded) {
  size_t levels = 1;
  if (padded / NSVCD__GROUP <= NSVCD__TILE) return 1;
  while (nsvcd__level_of(padded, levels - 1).count > NSVCD__GROUP) levels++;
  return levels;
}

// Accessors: x, y, z and r are (P), of the patches.
static size_t nsvcd__body_groups(const nsvcd_body *body) {
  return body->padded / NSVCD__GROUP;
}
static const float *nsvcd__body_floats(const nsvcd_body *body, size_t first) {
  return (const float *)(body + 1) + first;
}
static const float *nsvcd__body_r(const nsvcd_body *body) {
  return nsvcd__body_floats(body, 3 * body->padded);
}
static nsvcd__spheres nsvcd__body_patches(const nsvcd_body *body) {
  return nsvcd__spheres_of(nsvcd__body_floats(body, 0), body->padded);
}
static nsvcd__spheres nsvcd__level_spheres(const nsvcd_body *body, nsvcd__level level) {
  return nsvcd__spheres_of(nsvcd__body_floats(body, level.first), level.slots);
}
static nsvcd__spheres nsvcd__groups_of(const nsvcd_body *body) {
  return nsvcd__level_spheres(body, nsvcd__level_of(body->padded, 0));
}
static nsvcd__sphere nsvcd__body_sphere(const nsvcd_body *body) {
  const nsvcd__sphere out = {nsvcd__f3_load(body->centre), body->radius};
  return out;
}

// The same place of a body that is being written.
static void *nsvcd__writable(nsvcd_body *body, const void *place) {
  return (char *)body + ((const char *)place - (const char *)body);
}

// Spheres with their padding: of the patches and all levels.
static size_t nsvcd__sphere_slots(size_t padded) {
  const size_t levels = nsvcd__level_count(padded);
  const nsvcd__level top = nsvcd__level_of(padded, levels - 1);
  return top.first / 4 + top.slots;
}

// Bytes of the header and the spheres, with which both kinds of bodies begin.
static size_t nsvcd__spheres_size(size_t padded) {
  return sizeof(struct nsvcd_body) + 16 * nsvcd__sphere_slots(padded);
}

// Area vectors with their padding: one for each sphere, but where there are no levels above the
// groups, of patches alone.
static size_t nsvcd__area_slots(size_t padded) {
  return nsvcd__level_count(padded) > 1 ? nsvcd__sphere_slots(padded) : padded;
}
// (3, P)
static const float *nsvcd__body_areas(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const float *)(const void *)at;
}
// Bytes of a body of latents up to these.
static size_t nsvcd__areas_end(size_t padded) {
  return nsvcd__spheres_size(padded) + 12 * nsvcd__area_slots(padded);
}

#ifndef NSVCD_NO_NETWORK
// The sums over the spheres of a level of a body that has some above the groups, (3, slots): they
// lie as the spheres do.
static const float *nsvcd__level_areas(const nsvcd_body *body, nsvcd__level level) {
  return nsvcd__body_areas(body) + level.first / 4 * 3;
}
// (N, LATENT)
static const int8_t *nsvcd__body_latents(const nsvcd_body *body) {
  return (const int8_t *)(nsvcd__body_areas(body) + 3 * nsvcd__area_slots(body->padded));
}
#endif

#ifndef NSVCD_NO_NETWORK
NSVCDDEF size_t nsvcd_body_size(size_t patches) {
  if (patches < 1 || patches > NSVCD_MAX_PATCHES) return 0;
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t latents = patches * NSVCD__LATENT;
  return nsvcd__round_up(nsvcd__areas_end(padded) + latents, NSVCD_ALIGNMENT);
}
#endif

// FNV-1a, 64 bits, over 32-bit words: every step is a bijection of the state, so no single changed
// word is missed.
static uint64_t nsvcd__body_checksum(const nsvcd_body *body) {
  const char *bytes = (const char *)body;
  uint64_t hash = 14695981039346656037u;
  for (size_t i = offsetof(struct nsvcd_body, size); i < body->size; i += 4) {
    uint32_t word;
    memcpy(&word, bytes + i, 4);
    hash = (hash ^ word) * 1099511628211u;
  }
  return hash;
}

#ifndef NSVCD_NO_ENCODER
// Numbers of patches that are being sorted.
typedef struct nsvcd__ordering {
  // of all patches
  const nsvcd__f3 *centres;
  uint16_t *order;  // (count)
  // (count), working memory
  uint16_t *spare;
  size_t count;
} nsvcd__ordering;

// Sorts patches by a coordinate of their centres, merging ever longer runs. Equal ones keep their
// order, so that the result is the same everywhere.
static void nsvcd__sort_along(nsvcd__ordering all, size_t axis) {
  const float *at = (const float *)(const void *)all.centres + axis;
  for (size_t run = 1; run < all.count; run *= 2) {
    for (size_t first = 0; first < all.count; first += 2 * run) {
      const size_t middle = first + run < all.count ? first + run : all.count;
      const size_t end = first + 2 * run < all.count ? first + 2 * run : all.count;
      size_t left = first;
      size_t right = middle;
      for (size_t to = first; to < end; to++) {
        int from_right = left == middle;
        if (left < middle && right < end)
          from_right = at[3 * all.order[right]] < at[3 * all.order[left]];
        all.spare[to] = from_right ? all.order[right++] : all.order[left++];
      }
    }
    memcpy(all.order, all.spare, all.count * sizeof *all.order);
  }
}

// Orders patches so that each run of 16 is compact, and each run of 16 of those: median splits
// across the longest axis of the centres' box, the left part a multiple of 16, or of 256 and so on
// where there are more than a tile's.
static void nsvcd__body_order(nsvcd__ordering all) {
  if (all.count <= NSVCD__GROUP) return;
  nsvcd__f3 low = all.centres[all.order[0]];
  nsvcd__f3 high = low;
  for (size_t i = 1; i < all.count; i++) {
    low = nsvcd__f3_min(low, all.centres[all.order[i]]);
    high = nsvcd__f3_max(high, all.centres[all.order[i]]);
  }
  const nsvcd__f3 size = nsvcd__f3_sub(high, low);
  const size_t axis = size.y > size.x ? 1 : 0;
  const int is_z = size.z > (axis ? size.y : size.x);
  nsvcd__sort_along(all, is_z ? 2 : axis);
  size_t unit = NSVCD__GROUP;
  while (2 * NSVCD__GROUP * unit < all.count) unit *= NSVCD__GROUP;
  nsvcd__ordering left = all;
  nsvcd__ordering right = all;
  left.count = nsvcd__round_up(all.count / 2, unit);
  right.count = all.count - left.count;
  right.order += left.count;
  nsvcd__body_order(left);
  nsvcd__body_order(right);
}

// Begins a body of so many patches in `memory`: zeros, the header, and the padding of the patches'
// spheres.
static nsvcd_body *nsvcd__body_begin(void *memory, size_t size, size_t patches, int open) {
  nsvcd_body *b = (nsvcd_body *)memory;
  memset(memory, 0, size);
  b->magic = NSVCD__BODY_MAGIC;
  b->version = NSVCD__BODY_VERSION;
  b->size = (uint32_t)size;
  b->patches = (uint32_t)patches;
  b->padded = (uint32_t)nsvcd__round_up(patches, NSVCD__GROUP);
  b->open = open != 0;
  float *radii = (float *)(b + 1) + 3 * b->padded;
  for (size_t i = patches; i < b->padded; i++) radii[i] = NSVCD__NOWHERE;
  return b;
}
#endif

// Do 16 spheres end nearer to a place than at a distance, but for roundings? Needs no roots, and
// compilers do it for several at a time.
static int nsvcd__are_within(nsvcd__spheres all, nsvcd__f3 centre, float distance) {
  int within = 1;
  for (size_t i = 0; i < NSVCD__GROUP; i++) {
    const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, i), centre);
    const float gap = distance - all.r[i];
    within &= (gap > 0) & (nsvcd__f3_dot(offset, offset) < gap * gap);
  }
  return within;
}

// The distance of the farthest point of `count` spheres from a place; *farthest is the sphere that
// has it, if it is above 0. Before, it is a guess: the better, the sooner this is done.
static float nsvcd__reach_of_spheres(nsvcd__spheres all, size_t count, nsvcd__f3 centre,
                                     size_t *farthest) {
  const nsvcd__sphere guess = nsvcd__sphere_of(all, *farthest);
  // less by more than the roundings: the farthest is never passed over
  const float share = 0.999998f;
  float least = share * (nsvcd__f3_length(nsvcd__f3_sub(guess.centre, centre)) + guess.radius);
  float reach = 0;
  for (size_t first = 0; first < count; first += NSVCD__GROUP) {
    const size_t left = count - first;
    const size_t end = left < NSVCD__GROUP ? count : first + NSVCD__GROUP;
    const nsvcd__spheres some = nsvcd__spheres_from(all, first);
    if (left >= NSVCD__GROUP && nsvcd__are_within(some, centre, least)) continue;
    for (size_t i = first; i < end; i++) {
      const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, i), centre);
      const float to = nsvcd__f3_length(offset) + all.r[i];
      if (to > reach) *farthest = i;
      reach = to > reach ? to : reach;
    }
    least = share * reach > least ? share * reach : least;
  }
  return reach;
}

// A sphere over `count` spheres: from the middle of their box, ever shorter steps towards the
// farthest (Badoiu and Clarkson 2003), the best one kept. The radius is rounded up by more than any
// compiler's rounding.
static nsvcd__sphere nsvcd__cover_spheres(nsvcd__spheres all, size_t count) {
  nsvcd__f3 low = nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF);
  nsvcd__f3 high = nsvcd__f3_scale(low, -1);
  for (size_t i = 0; i < count; i++) {
    const nsvcd__f3 r = nsvcd__f3_of(all.r[i], all.r[i], all.r[i]);
    const nsvcd__f3 centre = nsvcd__centre_of(all, i);
    low = nsvcd__f3_min(low, nsvcd__f3_sub(centre, r));
    high = nsvcd__f3_max(high, nsvcd__f3_add(centre, r));
  }
  nsvcd__f3 centre = nsvcd__f3_add(nsvcd__f3_scale(low, 0.5f), nsvcd__f3_scale(high, 0.5f));
  nsvcd__sphere best = {centre, HUGE_VALF};
  size_t farthest = 0;
  for (int step = 0; step < 32; step++) {
    const float reach = nsvcd__reach_of_spheres(all, count, centre, &farthest);
    if (reach < best.radius) {
      best.centre = centre;
      best.radius = reach;
    }
    const nsvcd__f3 way = nsvcd__f3_sub(nsvcd__centre_of(all, farthest), centre);
    const float steps = (float)(step + 3);
    centre.x += way.x / steps;
    centre.y += way.y / steps;
    centre.z += way.z / steps;
  }
  best.radius *= 1.000002f;
  return best;
}

// Fills a level with spheres over 16 spheres each, of so many.
static void nsvcd__cover_level(nsvcd_body *body, size_t k, nsvcd__spheres below,
                               size_t members) {
  const nsvcd__level level = nsvcd__level_of(body->padded, k);
  float *out = (float *)(body + 1) + level.first;
  for (size_t g = 0; g < level.slots; g++) {
    nsvcd__sphere sphere = {{0, 0, 0}, NSVCD__NOWHERE};
    const size_t i = g * NSVCD__GROUP;
    const size_t left = i >= members ? 0 : members - i;
    const size_t count = left < NSVCD__GROUP ? left : NSVCD__GROUP;
    if (count) sphere = nsvcd__cover_spheres(nsvcd__spheres_from(below, i), count);
    nsvcd__sphere_store(sphere, out, level.slots, g);
  }
}

// Fills the spheres above the groups, the bounding sphere and the extent of a blob whose patches
// and groups are in place.
static void nsvcd__body_finish(nsvcd_body *body) {
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  const nsvcd__spheres groups = nsvcd__groups_of(body);
  for (size_t k = 1; k < nsvcd__level_count(body->padded); k++) {
    const nsvcd__level below = nsvcd__level_of(body->padded, k - 1);
    nsvcd__cover_level(body, k, nsvcd__level_spheres(body, below), below.count);
  }
  size_t farthest = 0;
  const nsvcd__f3 origin = nsvcd__f3_of(0, 0, 0);
  const nsvcd__sphere over = nsvcd__cover_spheres(patches, body->patches);
  const nsvcd__sphere above = nsvcd__cover_spheres(groups, nsvcd__body_groups(body));
  const nsvcd__sphere sphere = above.radius < over.radius ? above : over;
  const float extent = nsvcd__reach_of_spheres(patches, body->patches, origin, &farthest);
  nsvcd__f3_store(sphere.centre, body->centre);
  body->radius = sphere.radius;
  body->extent = extent * 1.000002f;
}

static int nsvcd__is_aligned(const void *memory) {
  return ((uintptr_t)memory & (NSVCD_ALIGNMENT - 1)) == 0;
}

// Are numbers finite, and their absolute values no greater than `most`? By their bits, so that it
// holds under -ffast-math too.
static int nsvcd__within(const float *values, size_t count, float most) {
  for (size_t i = 0; i < count; i++) {
    if (!nsvcd__is_finite(values[i]) || fabsf(values[i]) > most) return 0;
  }
  return 1;
}

// Are the area vectors of a body of latents in range?
static int nsvcd__areas_are_sound(const nsvcd_body *body) {
  return nsvcd__within(nsvcd__body_areas(body), 3 * nsvcd__area_slots(body->padded),
                       NSVCD__MAX_LENGTH * NSVCD__MAX_LENGTH);
}

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_NETWORK)
// What a body of latents is built of.
typedef struct nsvcd__latents_source {
  size_t count;              // N
  const nsvcd__f3 *centres;  // (N)
  const float *radii;        // (N)
  const nsvcd__f3 *areas;    // (N)
  const int8_t *latents;     // (N, LATENT)
  // (N) of the patches
  const uint16_t *order;
  int open;
} nsvcd__latents_source;

// Builds a body of latents in `memory`, nsvcd_body_size bytes. NUMBER if something is out of
// bounds, EMPTY if it is too small.
static nsvcd_result nsvcd__body_build(const nsvcd__latents_source *source, void *memory) {
  const size_t count = source->count;
  nsvcd_body *b = nsvcd__body_begin(memory, nsvcd_body_size(count), count, source->open);
  const size_t padded = b->padded;
  b->weights_id = NSVCD_WEIGHTS_ID;
  float *spheres = (float *)(b + 1);
  float *areas = (float *)nsvcd__writable(b, nsvcd__body_areas(b));
  int8_t *latents = (int8_t *)(areas + 3 * nsvcd__area_slots(padded));
  for (size_t i = 0; i < count; i++) {
    const size_t from = source->order[i];
    const nsvcd__sphere sphere = {source->centres[from], source->radii[from]};
    nsvcd__sphere_store(sphere, spheres, padded, i);
    nsvcd__f3_put(source->areas[from], areas + i, padded);
    memcpy(latents, source->latents + NSVCD__LATENT * from, NSVCD__LATENT);
    latents += NSVCD__LATENT;
  }
  // The levels, if there are any above the groups, have the sums over what is below.
  const size_t levels = nsvcd__level_count(padded);
  const float *below = areas;
  size_t stride = padded;
  for (size_t n = 0; levels > 1 && n < levels; n++) {
    const nsvcd__level level = nsvcd__level_of(padded, n);
    float *sums = areas + level.first / 4 * 3;
    for (size_t i = 0; i < 3 * stride; i++)
      sums[i / stride * level.slots + i % stride / NSVCD__GROUP] += below[i];
    below = sums;
    stride = level.slots;
  }
  int sound = nsvcd__within(spheres, 3 * padded, NSVCD_MAX_COORDINATE);
  sound = sound && nsvcd__within(nsvcd__body_r(b), count, 4 * NSVCD_MAX_COORDINATE);
  if (!sound || !nsvcd__areas_are_sound(b)) return NSVCD_ERROR_NUMBER;
  nsvcd__cover_level(b, 0, nsvcd__body_patches(b), count);
  nsvcd__body_finish(b);
  b->checksum = nsvcd__body_checksum(b);
  return b->radius < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif

// --------------------------------------------------------------------------------------- body/walk
// In: a body and a filter of spheres. Out: the groups whose spheres pass.

// Which of 16 spheres are of interest? Bits of lanes.
typedef uint32_t nsvcd__filter(const void *what, nsvcd__spheres spheres);

// Finds the groups whose spheres, and all spheres over them, pass a filter, in their order.
typedef struct nsvcd__walk {
  const nsvcd_body *body;
  nsvcd__filter *filter;
  const void *what;
  size_t levels, level;
  // on each level, the first of the spheres looked at
  uint32_t first[NSVCD__LEVELS];
  // and those of them that passed, and are still to be visited
  uint32_t left[NSVCD__LEVELS];
} nsvcd__walk;

// Which of 16 spheres of a level pass? Bits of lanes.
static uint32_t nsvcd__walk_look(const nsvcd__walk *walk, size_t level, size_t first) {
  const nsvcd__level at = nsvcd__level_of(walk->body->padded, level);
  const nsvcd__spheres all = nsvcd__level_spheres(walk->body, at);
  return walk->filter(walk->what, nsvcd__spheres_from(all, first));
}

static void nsvcd__walk_begin(nsvcd__walk *walk, const nsvcd_body *body, nsvcd__filter *filter,
                              const void *what) {
  walk->body = body;
  walk->filter = filter;
  walk->what = what;
  walk->levels = nsvcd__level_count(body->padded);
  walk->level = walk->levels - 1;
  walk->first[walk->level] = 0;
  uint32_t left = 0;
  const size_t slots = nsvcd__level_of(body->padded, walk->level).slots;
  for (size_t first = 0; first < slots; first += NSVCD__GROUP)
    left |= nsvcd__walk_look(walk, walk->level, first) << first;
  walk->left[walk->level] = left;
}

// The next group; 0 if there is none.
static int nsvcd__walk_next(nsvcd__walk *walk, size_t *group) {
  for (;;) {
    while (!walk->left[walk->level]) {
      if (walk->level + 1 == walk->levels) return 0;
      walk->level++;
    }
    uint32_t *left = &walk->left[walk->level];
    const size_t found = walk->first[walk->level] + nsvcd__low_bit(*left);
    *left &= *left - 1;
    if (walk->level == 0) {
      *group = found;
      return 1;
    }
    walk->level--;
    walk->first[walk->level] = (uint32_t)(NSVCD__GROUP * found);
    walk->left[walk->level] = nsvcd__walk_look(walk, walk->level, NSVCD__GROUP * found);
  }
}

// ------------------------------------------------------------------------------------- body/facets
// In: the surface of each patch. Out: the blob of the proof, and what it says of a patch.
//
// The body of triangles. Its spheres are the least about each patch's pieces of the surface. Behind
// them stand
//
//   counts          (4)      uint32: triangles listed L, vertices V, components C, bytes of
//                            listings B
//   round           (1)      float: metres that the body goes beyond its triangles
//   zeros           (3)      uint32
//   box             (2, 3)   float: least and greatest coordinates of the surface
//   widest          (2)      float: the greatest of the quanta, and zero
//   discs           (6, P)   float: normal n, low, high, across: points x of a piece have
//                            low <= n.(x - c) <= high, and are no farther than `across` from the
//                            line along n; c: centre of the patch's sphere
//   group discs     (6, G)   float: the same over the members of each group; c: centre of the
//                            group's sphere
//   steps           (P)      float: metres per integer: a stored vertex is c + step (x, y, z)
//   slacks          (P)      float: pieces are within this of the hull of the first vertices
//   quanta          (P)      float: corners of triangles are within this of the stored vertices
//   first_vertex, first_triangle, first_byte
//                   (3, N + 1) uint32: where a patch's vertices, triangles and listings begin
//   first_seed      (G' + 1) uint32: where the seeds of a group begin; G': groups, without the
//                            padding
//   seeds           (C, 3)   float: a point of each component, group by group, within its sphere
//   vertices        (3 V)    int16: patch by patch x, y, z; the hull's first
//                   (16)     int16: so that 16 can be read from any vertex on
//   listings        (B)      bytes: patch by patch, of its T triangles
//     corners       (T, 3)   uint8, or uint16 in patches of more than 256 vertices: vertices within
//                            the patch
//     numbers       (T)      each in 1 to 5 bytes: see nsvcd__read_code
//   hull_counts     (N)      uint8: vertices of the hull, 16 at most; 0: the patch has no surface

#ifndef NSVCD_NO_PROOF
#define NSVCD__HULLS (NSVCD__GROUP * NSVCD__HULL)  // vertices of a group, at most
#define NSVCD__FACET_BOX 8                         // with the greatest quantum

typedef struct nsvcd__facet_counts {
  uint32_t listed, vertices, components, listings_size;
  float round;
  uint32_t zeros[3];
} nsvcd__facet_counts;

typedef struct nsvcd__facets {
  // of triangles
  const nsvcd_body *body;
  const float *box, *discs, *group_discs, *steps, *slacks, *quanta;
  const uint32_t *first_vertex, *first_triangle, *first_byte, *first_seed;
  const float *seeds;
  const int16_t *vertices;
  const unsigned char *listings;
  const uint8_t *hull_counts;
  size_t listed, vertex_count, components, listings_size;
  float round;
} nsvcd__facets;

// The body of triangles in a body, or NULL.
static const nsvcd_body *nsvcd__triangles_of(const nsvcd_body *body) {
  if (body->triangles == 0 || body->weights_id == 0) return body->triangles ? body : NULL;
  return (const nsvcd_body *)(const void *)((const char *)body + body->inner);
}

static const nsvcd__facet_counts *nsvcd__counts_of(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const nsvcd__facet_counts *)(const void *)at;
}

// The next `count` numbers in a body, or, where that is NULL, only counts them.
#define NSVCD__PASS(type, count) ((const type *)nsvcd__pass(body, &at, count, sizeof(type)))
static const void *nsvcd__pass(const nsvcd_body *body, uint64_t *at, uint64_t count,
                               size_t size) {
  const void *out = body ? (const char *)body + *at : NULL;
  *at += count * size;
  return out;
}

// Where all is in a body of so many patches. body: NULL to know only how large it is to be. Returns
// its bytes; 0 if they cannot be counted in 32 bits.
static size_t nsvcd__facets_lay(const nsvcd_body *body, size_t patches,
                                const nsvcd__facet_counts *counts, nsvcd__facets *f) {
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t starts = patches + 1;
  uint64_t at = nsvcd__spheres_size(padded) + sizeof *counts;
  f->body = body;
  f->listed = counts->listed;
  f->vertex_count = counts->vertices;
  f->components = counts->components;
  f->listings_size = counts->listings_size;
  f->round = counts->round;
  f->box = NSVCD__PASS(float, NSVCD__FACET_BOX);
  f->discs = NSVCD__PASS(float, 6 * padded);
  f->group_discs = NSVCD__PASS(float, 6 * nsvcd__group_slots(padded));
  f->steps = NSVCD__PASS(float, padded);
  f->slacks = NSVCD__PASS(float, padded);
  f->quanta = NSVCD__PASS(float, padded);
  f->first_vertex = NSVCD__PASS(uint32_t, starts);
  f->first_triangle = NSVCD__PASS(uint32_t, starts);
  f->first_byte = NSVCD__PASS(uint32_t, starts);
  f->first_seed = NSVCD__PASS(uint32_t, padded / NSVCD__GROUP + 1);
  f->seeds = NSVCD__PASS(float, (uint64_t)3 * f->components);
  f->vertices = NSVCD__PASS(int16_t, (uint64_t)3 * f->vertex_count + NSVCD__LANES);
  f->listings = NSVCD__PASS(unsigned char, f->listings_size);
  f->hull_counts = NSVCD__PASS(uint8_t, patches);
  at += NSVCD_ALIGNMENT - at % NSVCD_ALIGNMENT;
  return at > 0xffffffffu ? 0 : (size_t)at;
}

static nsvcd__facets nsvcd__facets_of(const nsvcd_body *body) {
  nsvcd__facets f;
  (void)nsvcd__facets_lay(body, body->patches, nsvcd__counts_of(body), &f);
  return f;
}

static float nsvcd__widest_quantum(const nsvcd__facets *f) {
  return f->box[6];
}

// ---- one patch

// The vertices of a patch: integers, in steps from its centre.
typedef struct nsvcd__vertices {
  // (count) each
  const int16_t *x, *y, *z;
  size_t count;
} nsvcd__vertices;

NSVCD__INLINE nsvcd__vertices nsvcd__vertices_of(const nsvcd__facets *f, size_t patch) {
  const size_t first = f->first_vertex[patch];
  nsvcd__vertices out;
  out.count = f->first_vertex[patch + 1] - first;
  out.x = f->vertices + 3 * first;
  out.y = out.x + out.count;
  out.z = out.y + out.count;
  return out;
}
static nsvcd__d3 nsvcd__vertex_at(const nsvcd__vertices *vertices, size_t i) {
  return nsvcd__d3_of(vertices->x[i], vertices->y[i], vertices->z[i]);
}

// Bytes of a corner in a patch of so many vertices.
static size_t nsvcd__corner_bytes(size_t vertices) {
  return vertices <= 256 ? 1 : 2;
}

// The vertex, of its patch, of corner k (0..2) of listing n.
static size_t nsvcd__facet_corner(const nsvcd__facets *f, size_t patch, size_t n, size_t k) {
  const unsigned char *corners = f->listings + f->first_byte[patch];
  const size_t at = 3 * (n - f->first_triangle[patch]) + k;
  if (nsvcd__corner_bytes(nsvcd__vertices_of(f, patch).count) == 1) return corners[at];
  uint16_t corner;
  memcpy(&corner, corners + 2 * at, sizeof corner);
  return corner;
}

// The numbers of a patch's triangles in the caller's mesh follow each other as codes: twice what
// the number is more than the one before, modulo 2^31, the lowest bit set if the triangle belongs
// to a closed component. A code is stored 7 bits a byte, the lowest first; the top bit says that
// there are more. Most take one byte, for neighbours have near numbers.
static uint32_t nsvcd__read_code(const unsigned char **at) {
  uint32_t code = 0;
  for (unsigned shift = 0; shift < 35; shift += 7) {
    const uint32_t byte = *(*at)++;
    code |= (byte & 0x7f) << shift;
    if (!(byte & 0x80)) break;
  }
  return code;
}

// The numbers of a patch's triangles, read one after another.
typedef struct nsvcd__numbers {
  const unsigned char *at;
  size_t next;      // listing
  uint32_t number;  // of the one before
  // does it belong to a closed component?
  int encloses;
} nsvcd__numbers;

static nsvcd__numbers nsvcd__numbers_of(const nsvcd__facets *f, size_t patch) {
  const size_t bytes = nsvcd__corner_bytes(nsvcd__vertices_of(f, patch).count);
  const size_t triangles = f->first_triangle[patch + 1] - f->first_triangle[patch];
  nsvcd__numbers out;
  out.at = f->listings + f->first_byte[patch] + 3 * triangles * bytes;
  out.next = f->first_triangle[patch];
  out.number = 0;
  out.encloses = 0;
  return out;
}

// Reads on until listing n, which has not been read before.
static void nsvcd__read_number(nsvcd__numbers *numbers, size_t n) {
  for (; numbers->next <= n; numbers->next++) {
    const uint32_t code = nsvcd__read_code(&numbers->at);
    numbers->number = (numbers->number + (code >> 1)) & ~NSVCD__ENCLOSES;
    numbers->encloses = (int)(code & 1);
    NSVCD__TALLY(numbers, 1);
  }
}

// The triangle, in the caller's mesh, of listing n.
static uint32_t nsvcd__facet_number(const nsvcd__facets *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.number;
}

static nsvcd__f3 nsvcd__facet_centre(const nsvcd__facets *f, size_t patch) {
  return nsvcd__centre_of(nsvcd__body_patches(f->body), patch);
}
// The same in double: what the vertices are counted from.
static nsvcd__d3 nsvcd__facet_origin(const nsvcd__facets *f, size_t patch) {
  return nsvcd__d3_widen(nsvcd__facet_centre(f, patch));
}

// The corners (3) of listing n of a patch, exactly.
static void nsvcd__facet_triangle(const nsvcd__facets *f, size_t patch, size_t n,
                                  nsvcd__d3 *corners) {
  const nsvcd__vertices vertices = nsvcd__vertices_of(f, patch);
  const nsvcd__d3 origin = nsvcd__facet_origin(f, patch);
  const double step = (double)f->steps[patch];
  for (size_t k = 0; k < 3; k++) {
    const size_t i = nsvcd__facet_corner(f, patch, n, k);
    const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, i);
    corners[k] = nsvcd__d3_fma(step, vertex, origin);
  }
}

// ---- what follows from the patches

// A float not less than x, which is not negative.
static float nsvcd__round_outward(double x) {
  return (float)(x * (1 + 2e-7)) + 1e-37f;
}

// What the members of a group extend to along a direction and across it, from the centre of the
// group's sphere. One that is seen to be no thinner than `most` is not measured to the end.
typedef struct nsvcd__slab {
  double low, high, across;
} nsvcd__slab;

static nsvcd__slab nsvcd__slab_of_group(const nsvcd__facets *f, size_t g, nsvcd__d3 normal,
                                        double most) {
  const size_t first = NSVCD__GROUP * g;
  const nsvcd__spheres groups = nsvcd__groups_of(f->body);
  const nsvcd__d3 centre = nsvcd__d3_widen(nsvcd__centre_of(groups, g));
  nsvcd__slab slab = {HUGE_VAL, -HUGE_VAL, 0};
  for (size_t i = first; i < first + NSVCD__GROUP && i < f->body->patches; i++) {
    if (slab.high - slab.low >= most) break;
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 own = nsvcd__d3_sub(nsvcd__facet_origin(f, i), centre);
    const double step = (double)f->steps[i];
    const double slack = (double)f->slacks[i];
    double farthest = 0;
    for (size_t k = 0; k < f->hull_counts[i]; k++) {
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      const nsvcd__d3 v = nsvcd__d3_fma(step, vertex, own);
      const double height = nsvcd__d3_dot(normal, v);
      farthest = nsvcd__max(farthest, nsvcd__d3_dot(v, v) - height * height);
      slab.low = nsvcd__min(slab.low, height - slack);
      slab.high = nsvcd__max(slab.high, height + slack);
    }
    if (f->hull_counts[i]) slab.across = nsvcd__max(slab.across, sqrt(farthest) + slack);
  }
  return slab;
}

// Writes a group's disc. Its normal is the mean of the members', or that of every fourth member:
// the one in which the group is thinnest.
static void nsvcd__finish_group(nsvcd_body *b, size_t g) {
  const nsvcd__facets f = nsvcd__facets_of(b);
  nsvcd__d3 normals[1 + NSVCD__GROUP] = {{0, 0, 0}};
  for (size_t k = 0; k < NSVCD__GROUP; k++) {
    const float *n = f.discs + NSVCD__GROUP * g + k;
    const nsvcd__d3 normal = nsvcd__d3_widen(nsvcd__f3_get(n, b->padded));
    normals[1 + k] = normal;
    const double sign = nsvcd__d3_dot(normal, normals[1]) < 0 ? -1 : 1;
    normals[0] = nsvcd__d3_fma(sign, normal, normals[0]);
  }
  nsvcd__d3 best = {0, 0, 1};
  nsvcd__slab thinnest = {0, HUGE_VAL, 0};
  for (size_t k = 0; k < 1 + NSVCD__GROUP; k += k == 0 ? 1 : 4) {
    const double length = nsvcd__d3_length(normals[k]);
    if (!(length > 1e-3)) continue;
    // As it is stored, and no longer than 1.
    const nsvcd__d3 shorter = nsvcd__d3_scale(normals[k], 0.9999998 / length);
    const nsvcd__d3 unit = nsvcd__d3_widen(nsvcd__f3_round(shorter));
    const double most = thinnest.high - thinnest.low;
    const nsvcd__slab slab = nsvcd__slab_of_group(&f, g, unit, most);
    if (!(slab.high - slab.low < most)) continue;
    thinnest = slab;
    best = unit;
  }
  // float rounding, and that `across` takes |n| to be 1
  const double margin = 1e-6 * (double)b->extent;
  nsvcd__disc disc;
  disc.normal = nsvcd__f3_round(best);
  disc.low = (float)(thinnest.low - margin);
  disc.high = thinnest.high < HUGE_VAL ? (float)(thinnest.high + margin) : 0;
  disc.across = nsvcd__round_outward(thinnest.across + margin);
  float *discs = (float *)nsvcd__writable(b, f.group_discs);
  nsvcd__disc_store(disc, discs, nsvcd__group_slots(b->padded), g);
}

// The surface in a group: spheres about the vertices of its patches' hulls. A patch without surface
// is a point.
typedef struct nsvcd__hulls {
  size_t count;
  float spheres[4][NSVCD__HULLS];  // x, y, z, r
} nsvcd__hulls;

static void nsvcd__gather_hulls(const nsvcd__facets *f, size_t g, nsvcd__hulls *out) {
  const size_t end = NSVCD__GROUP * (g + 1);
  out->count = 0;
  for (size_t i = end - NSVCD__GROUP; i < end && i < f->body->patches; i++) {
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 origin = nsvcd__facet_origin(f, i);
    const double step = (double)f->steps[i];
    const size_t count = f->hull_counts[i];
    for (size_t k = 0; k < count + !count; k++) {
      nsvcd__d3 v = {0, 0, 0};
      if (count) v = nsvcd__vertex_at(&vertices, k);
      v = nsvcd__d3_fma(step, v, origin);
      // as float rounds it
      const double rounding = 1.1e-7 * nsvcd__d3_length(v);
      const double radius = (double)f->slacks[i] + rounding;
      const size_t n = out->count++;
      out->spheres[3][n] = nsvcd__round_outward(radius);
      nsvcd__f3_put(nsvcd__f3_round(v), &out->spheres[0][n], NSVCD__HULLS);
    }
  }
}

static nsvcd__spheres nsvcd__hull_spheres(const nsvcd__hulls *hulls) {
  return nsvcd__spheres_of(hulls->spheres[0], NSVCD__HULLS);
}

// What is computed from the patches of a body of triangles, when these are in place: the spheres
// above them, the box with the greatest of the quanta, and the groups' discs.
static void nsvcd__facets_finish(nsvcd_body *b) {
  const nsvcd__facets f = nsvcd__facets_of(b);
  const nsvcd__level groups = nsvcd__level_of(b->padded, 0);
  float *out = (float *)(b + 1) + groups.first;
  for (size_t g = 0; g < groups.slots; g++) {
    nsvcd__sphere over = {{0, 0, 0}, NSVCD__NOWHERE};
    nsvcd__hulls hulls;
    if (g < groups.count) {
      nsvcd__gather_hulls(&f, g, &hulls);
      over = nsvcd__cover_spheres(nsvcd__hull_spheres(&hulls), hulls.count);
    }
    nsvcd__sphere_store(over, out, groups.slots, g);
  }
  nsvcd__body_finish(b);
  const nsvcd__d3 all = {1, 1, 1};
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  float widest = 0;
  for (size_t i = 0; i < b->patches; i++) {
    const nsvcd__vertices vertices = nsvcd__vertices_of(&f, i);
    const nsvcd__d3 origin = nsvcd__facet_origin(&f, i);
    const double quantum = (double)f.quanta[i];
    nsvcd__d3 least = {32767, 32767, 32767};
    nsvcd__d3 most = {-32767, -32767, -32767};
    for (size_t k = 0; k < vertices.count; k++) {
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      least = nsvcd__d3_min(least, vertex);
      most = nsvcd__d3_max(most, vertex);
    }
    if (vertices.count == 0) continue;
    least = nsvcd__d3_fma((double)f.steps[i], least, origin);
    most = nsvcd__d3_fma((double)f.steps[i], most, origin);
    low = nsvcd__d3_min(low, nsvcd__d3_fma(-quantum, all, least));
    high = nsvcd__d3_max(high, nsvcd__d3_fma(quantum, all, most));
    widest = f.quanta[i] > widest ? f.quanta[i] : widest;
  }
  // float rounding
  const double margin = 1e-6 * (double)b->extent;
  float *box = (float *)nsvcd__writable(b, f.box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(-margin, all, low)), box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(margin, all, high)), box + 3);
  box[6] = widest;
  box[7] = 0;
  for (size_t g = 0; g < nsvcd__body_groups(b); g++) nsvcd__finish_group(b, g);
  b->checksum = nsvcd__body_checksum(b);
}

#ifndef NSVCD_NO_ENCODER
// ---- writing

// Writes the numbers of patch i as codes; NULL: only counts their bytes. Returns how many.
static size_t nsvcd__numbers_write(const nsvcd__surface *s, size_t i, unsigned char *to) {
  size_t size = 0;
  uint32_t last = 0;
  for (size_t n = s->first_triangle[i]; n < s->first_triangle[i + 1]; n++) {
    const uint32_t id = s->ids[n];
    uint32_t code = ((id - last) & ~NSVCD__ENCLOSES) << 1 | id >> 31;
    for (int more = 1; more; code >>= 7) {
      more = code > 0x7f;
      if (to) to[size] = (unsigned char)(more ? code | 0x80 : code);
      size++;
    }
    last = id;
  }
  return size;
}

// The counts of the body of triangles that a surface makes.
static nsvcd__facet_counts nsvcd__facets_count(const nsvcd__surface *s) {
  nsvcd__facet_counts counts;
  memset(&counts, 0, sizeof counts);
  counts.listed = (uint32_t)s->listed;
  counts.vertices = (uint32_t)s->vertex_count;
  counts.components = (uint32_t)s->seed_count;
  uint64_t bytes = 0;
  for (size_t i = 0; i < s->count; i++) {
    const size_t vertices = s->first_vertex[i + 1] - s->first_vertex[i];
    const size_t triangles = s->first_triangle[i + 1] - s->first_triangle[i];
    bytes += (uint64_t)3 * triangles * nsvcd__corner_bytes(vertices);
    bytes += nsvcd__numbers_write(s, i, NULL);
  }
  // then the body is refused as too large
  counts.listings_size = bytes < 0xffffffffu ? (uint32_t)bytes : 0xffffffffu;
  return counts;
}

// Writes patch `to`, from patch `from` of a surface. One without surface is a point.
static void nsvcd__patch_write(const nsvcd__surface *s, size_t from, nsvcd_body *b,
                               nsvcd__facets f, size_t to) {
  const size_t padded = b->padded;
  nsvcd__sphere ball = s->balls[from];
  if (s->hull_counts[from] == 0) ball.radius = 0;
  nsvcd__sphere_store(ball, (float *)(b + 1), padded, to);
  nsvcd__disc_store(s->discs[from], (float *)nsvcd__writable(b, f.discs), padded, to);
  *(float *)nsvcd__writable(b, f.steps + to) = s->steps[from];
  *(float *)nsvcd__writable(b, f.slacks + to) = s->slacks[from];
  *(float *)nsvcd__writable(b, f.quanta + to) = s->quanta[from];
  *(uint8_t *)nsvcd__writable(b, f.hull_counts + to) = s->hull_counts[from];

  const size_t vertex = s->first_vertex[from];
  const size_t vertices = s->first_vertex[from + 1] - vertex;
  const size_t first = s->first_triangle[from];
  const size_t end = s->first_triangle[from + 1];
  uint32_t *first_vertex = (uint32_t *)nsvcd__writable(b, f.first_vertex + to);
  uint32_t *first_triangle = (uint32_t *)nsvcd__writable(b, f.first_triangle + to);
  uint32_t *first_byte = (uint32_t *)nsvcd__writable(b, f.first_byte + to);
  void *integers = nsvcd__writable(b, f.vertices + 3 * (size_t)first_vertex[0]);
  memcpy(integers, s->vertices + 3 * vertex, 6 * vertices);
  unsigned char *begin = (unsigned char *)nsvcd__writable(b, f.listings + first_byte[0]);
  unsigned char *at = begin;
  const size_t bytes = nsvcd__corner_bytes(vertices);
  for (size_t n = 3 * first; n < 3 * end; n++) {
    const uint16_t corner = s->corners[n];
    if (bytes == 1) at[0] = (unsigned char)corner;
    if (bytes == 2) memcpy(at, &corner, 2);
    at += bytes;
  }
  at += nsvcd__numbers_write(s, from, at);
  first_vertex[1] = first_vertex[0] + (uint32_t)vertices;
  first_triangle[1] = first_triangle[0] + (uint32_t)(end - first);
  first_byte[1] = first_byte[0] + (uint32_t)(at - begin);
}

// Writes the seeds of a body of triangles, group by group (counting sort). order: of the patches.
static void nsvcd__seeds_write(const nsvcd__surface *s, const uint16_t *order, nsvcd_body *b) {
  const nsvcd__facets f = nsvcd__facets_of(b);
  uint32_t *first_seed = (uint32_t *)nsvcd__writable(b, f.first_seed);
  float *seeds = (float *)nsvcd__writable(b, f.seeds);
  // Until the body is whole, the places of patches are kept where their first vertices will be.
  uint32_t *places = (uint32_t *)nsvcd__writable(b, f.first_vertex);
  const size_t groups = nsvcd__body_groups(b);
  for (size_t i = 0; i < b->patches; i++) places[order[i]] = (uint32_t)i;
  for (size_t n = 0; n < s->seed_count; n++) {
    const size_t g = places[s->seed_patches[n]] / NSVCD__GROUP;
    first_seed[g + 1]++;
  }
  for (size_t g = 0; g < groups; g++) first_seed[g + 1] += first_seed[g];
  for (size_t n = s->seed_count; n-- > 0;) {
    const size_t g = places[s->seed_patches[n]] / NSVCD__GROUP;
    const size_t to = --first_seed[g + 1];
    nsvcd__f3_store(s->seeds[n], seeds + 3 * to);
  }
  // Now first_seed[g + 1] is where group g begins.
  memmove(first_seed, first_seed + 1, groups * sizeof *first_seed);
  first_seed[groups] = (uint32_t)s->seed_count;
  memset(places, 0, b->patches * sizeof *places);
}

// Builds a body of triangles of `size` bytes in `memory`. triangles: of the mesh. order: (N) of the
// patches. NUMBER if it would be too large, EMPTY if it would be too small.
static nsvcd_result nsvcd__facets_build(const nsvcd__surface *s,
                                        const nsvcd__facet_counts *counts, size_t triangles,
                                        const uint16_t *order, int open, void *memory,
                                        size_t size) {
  nsvcd_body *b = nsvcd__body_begin(memory, size, s->count, open);
  b->triangles = (uint32_t)triangles;
  memcpy(nsvcd__writable(b, nsvcd__counts_of(b)), counts, sizeof *counts);
  nsvcd__seeds_write(s, order, b);
  const nsvcd__facets f = nsvcd__facets_of(b);
  for (size_t i = 0; i < s->count; i++) nsvcd__patch_write(s, order[i], b, f, i);
  if (!nsvcd__within(nsvcd__body_r(b), b->patches, 4 * NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  nsvcd__facets_finish(b);
  return b->radius + counts->round < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif
#endif  // NSVCD_NO_PROOF

// Of a sphere about a body, with what it goes beyond its triangles.
static float nsvcd__whole_radius(const nsvcd_body *body) {
#ifndef NSVCD_NO_PROOF
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles) return body->radius + nsvcd__counts_of(triangles)->round;
#endif
  return body->radius;
}

// -------------------------------------------------------------------------------------- body/trust
// In: bytes that somebody hands over. Out: a body, if all in it is as nsvcd_encode would have it,
// or could have it.

// ---- the spheres, with which both kinds of bodies begin

// Does a sphere contain `count` spheres?
static int nsvcd__covers(nsvcd__sphere sphere, nsvcd__spheres all, size_t count) {
  size_t farthest = 0;
  return nsvcd__reach_of_spheres(all, count, sphere.centre, &farthest) <= sphere.radius;
}

// Are the first `count` of (4, slots) spheres finite and within bounds, their radii not negative,
// and the others exactly what padding is? most: of the coordinates.
static int nsvcd__are_spheres(nsvcd__spheres all, size_t count, size_t slots, float most) {
  if (!nsvcd__within(all.x, 3 * slots, most)) return 0;
  if (!nsvcd__within(all.r, count, NSVCD__MAX_LENGTH)) return 0;
  if (!nsvcd__within(all.r, slots, -NSVCD__NOWHERE)) return 0;
  for (size_t i = 0; i < count; i++) {
    if (all.r[i] < 0) return 0;
  }
  for (size_t i = count; i < slots; i++) {
    if (all.x[i] != 0 || all.y[i] != 0 || all.z[i] != 0) return 0;
    if (all.r[i] != NSVCD__NOWHERE) return 0;
  }
  return 1;
}

// Does each of a level's spheres cover its 16 of so many?
static int nsvcd__level_covers(nsvcd__spheres level, nsvcd__spheres below, size_t members) {
  for (size_t i = 0; i < members; i += NSVCD__GROUP) {
    const size_t count = members - i < NSVCD__GROUP ? members - i : NSVCD__GROUP;
    const nsvcd__sphere sphere = nsvcd__sphere_of(level, i / NSVCD__GROUP);
    if (!nsvcd__covers(sphere, nsvcd__spheres_from(below, i), count)) return 0;
  }
  return 1;
}

// Are the spheres of a blob, whose layout is right, finite and bounded, their radii not negative,
// and does each one above the groups cover what is below? A checksum stops accidents; this stops a
// blob made to harm: a lying sphere would hide collisions.
static int nsvcd__spheres_are_sound(const nsvcd_body *b) {
  const nsvcd__spheres patches = nsvcd__body_patches(b);
  const nsvcd__sphere about_origin = {nsvcd__f3_of(0, 0, 0), b->extent};
  if (!nsvcd__are_spheres(patches, b->patches, b->padded, NSVCD_MAX_COORDINATE)) return 0;
  if (!nsvcd__within(b->centre, 3, NSVCD__MAX_LENGTH)) return 0;
  if (!nsvcd__within(&b->radius, 1, NSVCD__MAX_LENGTH)) return 0;
  if (!nsvcd__within(&b->extent, 1, NSVCD__MAX_LENGTH)) return 0;
  if (b->radius < 0) return 0;
  const nsvcd__spheres groups = nsvcd__groups_of(b);
  nsvcd__spheres below = groups;
  size_t members = 0;
  for (size_t k = 0; k < nsvcd__level_count(b->padded); k++) {
    const nsvcd__level level = nsvcd__level_of(b->padded, k);
    const nsvcd__spheres above = nsvcd__level_spheres(b, level);
    if (!nsvcd__are_spheres(above, level.count, level.slots, NSVCD__MAX_LENGTH)) return 0;
    if (!nsvcd__level_covers(above, below, members)) return 0;
    below = above;
    members = level.count;
  }
  const nsvcd__sphere whole = nsvcd__body_sphere(b);
  if (!nsvcd__covers(about_origin, patches, b->patches)) return 0;
  return nsvcd__covers(whole, patches, b->patches) ||
         nsvcd__covers(whole, groups, nsvcd__body_groups(b));
}

// Would the spheres, multiplied, still be within the limits of nsvcd_body_load? In double, for the
// products may overflow a float.
static int nsvcd__spheres_fit(const nsvcd_body *b, float radius, float scale) {
  const double least = (double)NSVCD_MIN_RADIUS / (double)scale;
  const double most = (double)NSVCD_MAX_COORDINATE / (double)scale;
  if ((double)radius < least) return 0;
  for (size_t i = 0; i < 3 * (size_t)b->padded; i++) {
    if (fabs((double)nsvcd__body_patches(b).x[i]) > most) return 0;
  }
  // Twice the extent is over every radius and centre of a group.
  return 2 * (double)b->extent <= (double)NSVCD__MAX_LENGTH / (double)scale;
}

// ---- the triangles

#ifndef NSVCD_NO_PROOF
// Are counts and indices of a patch right? Those of the patches before it are.
static int nsvcd__patch_is_laid_out(const nsvcd__facets *f, size_t i) {
  const uint32_t *vertex = f->first_vertex + i;
  const uint32_t *triangle = f->first_triangle + i;
  if (vertex[1] < vertex[0] || vertex[1] > f->vertex_count) return 0;
  if (triangle[1] < triangle[0] || triangle[1] > f->listed) return 0;
  const size_t vertices = vertex[1] - vertex[0];
  const size_t triangles = triangle[1] - triangle[0];
  const size_t hull_count = f->hull_counts[i];
  if (hull_count > NSVCD__HULL || hull_count > vertices) return 0;
  if ((hull_count == 0) != (vertices == 0) || (vertices == 0) != (triangles == 0)) return 0;

  const uint64_t corners = (uint64_t)3 * triangles * nsvcd__corner_bytes(vertices);
  const uint64_t corners_end = f->first_byte[i] + corners;
  if (corners_end > f->first_byte[i + 1] || f->first_byte[i + 1] > f->listings_size) return 0;
  for (size_t n = 0; n < 3 * triangles; n++) {
    if (nsvcd__facet_corner(f, i, triangle[0] + n / 3, n % 3) >= vertices) return 0;
  }
  // Behind them are just as many codes, and all of triangles that there are.
  const unsigned char *at = f->listings + (size_t)corners_end;
  const unsigned char *end = f->listings + f->first_byte[i + 1];
  uint32_t number = 0;
  for (size_t n = 0; n < triangles; n++) {
    const size_t left = (size_t)(end - at);
    size_t bytes = 1;
    while (bytes < 5 && bytes < left && at[bytes - 1] & 0x80) bytes++;
    if (at >= end || at[bytes - 1] & 0x80) return 0;
    number = (number + (nsvcd__read_code(&at) >> 1)) & ~NSVCD__ENCLOSES;
    if (number >= f->body->triangles) return 0;
  }
  return at == end;
}
#endif  // NSVCD_NO_PROOF

// ---- whole bodies

// Is this the beginning of a blob of ours, of `size` bytes or fewer?
static int nsvcd__header_is_sound(const nsvcd_body *b, size_t size) {
  if (size < sizeof *b) return 0;
  if (b->magic != NSVCD__BODY_MAGIC || b->version != NSVCD__BODY_VERSION) return 0;
  if (b->patches < 1 || b->patches > NSVCD_MAX_PATCHES) return 0;
  if (b->open > 1 || b->size > size) return 0;
  if (b->padded != nsvcd__round_up(b->patches, NSVCD__GROUP)) return 0;
  return b->size >= nsvcd__spheres_size(b->padded) && b->size % NSVCD_ALIGNMENT == 0;
}

// Is all of a body of triangles sound: the spheres; the layout, which is sizes, counts and indices;
// and are the numbers in range? They may lie about the surface, but nothing that is computed from
// them overflows. It has at most `size` bytes, and a sound header.
static int nsvcd__triangles_are_sound(const nsvcd_body *b, size_t size) {
#ifndef NSVCD_NO_PROOF
  if (b->inner != 0 || !nsvcd__spheres_are_sound(b)) return 0;
  const size_t patches = b->patches;
  const size_t padded = b->padded;
  const size_t groups = nsvcd__body_groups(b);
  const size_t slots = nsvcd__group_slots(padded);
  const nsvcd__facet_counts *counts = nsvcd__counts_of(b);
  if (nsvcd__spheres_size(padded) + sizeof *counts > size) return 0;
  const uint32_t *zeros = counts->zeros;
  if (zeros[0] || zeros[1] || zeros[2] || b->triangles == 0) return 0;
  if (!nsvcd__within(&counts->round, 1, NSVCD_MAX_COORDINATE) || counts->round < 0) return 0;
  if (b->radius + counts->round < NSVCD_MIN_RADIUS) return 0;
  nsvcd__facets f;
  if (b->size != nsvcd__facets_lay(NULL, patches, counts, &f) || b->size > size) return 0;

  f = nsvcd__facets_of(b);
  if (f.first_vertex[0] != 0 || f.first_triangle[0] != 0) return 0;
  if (f.first_byte[0] != 0 || f.first_seed[0] != 0) return 0;
  for (size_t i = 0; i < patches; i++) {
    if (!nsvcd__patch_is_laid_out(&f, i)) return 0;
  }
  for (size_t g = 0; g < groups; g++) {
    if (f.first_seed[g + 1] < f.first_seed[g]) return 0;
  }
  if (f.first_vertex[patches] != f.vertex_count || f.first_triangle[patches] != f.listed)
    return 0;
  if (f.first_byte[patches] != f.listings_size || f.first_seed[groups] != f.components)
    return 0;

  for (size_t g = 0; g < groups; g++) {
    nsvcd__hulls hulls;
    nsvcd__gather_hulls(&f, g, &hulls);
    const nsvcd__spheres all = nsvcd__hull_spheres(&hulls);
    const nsvcd__sphere over = nsvcd__sphere_of(nsvcd__groups_of(b), g);
    if (!nsvcd__covers(over, all, hulls.count)) return 0;
  }

  const float most = NSVCD__MAX_LENGTH;
  if (!nsvcd__within(f.box, NSVCD__FACET_BOX, most)) return 0;
  if (!nsvcd__within(f.discs, 3 * padded, 1.000001f)) return 0;
  if (!nsvcd__within(f.discs + 3 * padded, 3 * padded, most)) return 0;
  if (!nsvcd__within(f.group_discs, 3 * slots, 1.000001f)) return 0;
  if (!nsvcd__within(f.group_discs + 3 * slots, 3 * slots, most)) return 0;
  if (!nsvcd__within(f.steps, padded, most / 32768)) return 0;
  if (!nsvcd__within(f.slacks, padded, most)) return 0;
  if (!nsvcd__within(f.quanta, padded, most)) return 0;
  if (!nsvcd__within(f.seeds, 3 * f.components, most)) return 0;
  for (size_t i = 0; i < padded; i++) {
    const nsvcd__disc disc = nsvcd__disc_at(f.discs, padded, i);
    if (disc.across < 0 || f.steps[i] < 0 || f.slacks[i] < 0 || f.quanta[i] < 0) return 0;
    if (f.quanta[i] > nsvcd__widest_quantum(&f)) return 0;
  }
#else
  (void)b;
  (void)size;  // never looked at
#endif
  return 1;
}

// Is all of a body sound, but for the checksum? Its header is.
static int nsvcd__body_is_sound(const nsvcd_body *b) {
  if (b->weights_id == 0) {
#ifndef NSVCD_NO_PROOF
    return nsvcd__triangles_are_sound(b, b->size);
#else
    return 0;
#endif
  }
  if (b->size < nsvcd__areas_end(b->padded)) return 0;
  if (!nsvcd__spheres_are_sound(b) || !nsvcd__areas_are_sound(b)) return 0;
  if (b->radius < NSVCD_MIN_RADIUS) return 0;
  if (!nsvcd__level_covers(nsvcd__groups_of(b), nsvcd__body_patches(b), b->patches)) return 0;
#ifndef NSVCD_NO_NETWORK
  if (b->weights_id != NSVCD_WEIGHTS_ID) return 0;
  const size_t latents = nsvcd_body_size(b->patches);
  if (b->size < latents) return 0;
  if (b->inner == 0) return b->size == latents && b->triangles == 0;
  if (b->inner != latents) return 0;
#else
  if (b->inner % NSVCD_ALIGNMENT || b->inner >= b->size) return 0;
  if (b->inner < nsvcd__areas_end(b->padded)) return 0;
#endif
  // the body of triangles within
  const char *at = (const char *)b + b->inner;
  const nsvcd_body *within = (const nsvcd_body *)(const void *)at;
  const size_t left = b->size - b->inner;
  if (!nsvcd__header_is_sound(within, left) || within->size != left) return 0;
  if (within->weights_id != 0 || within->open != b->open) return 0;
  if (within->patches != b->patches || within->triangles != b->triangles) return 0;
  return nsvcd__triangles_are_sound(within, left);
}

NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body) {
  if (!memory || !body) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_body *b = (const nsvcd_body *)memory;
  if (!nsvcd__is_aligned(memory) || !nsvcd__header_is_sound(b, size)) return NSVCD_ERROR_BODY;
#ifndef NSVCD_NO_NETWORK
  if (b->weights_id && b->weights_id != NSVCD_WEIGHTS_ID) return NSVCD_ERROR_BODY;
#endif
  *body = b;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_body_load(const void *memory, size_t size,
                                      const nsvcd_body **body) {
  const nsvcd_body *b = NULL;
  const nsvcd_result result = nsvcd_body_trust(memory, size, body ? &b : NULL);
  if (result) return result;
  if (b->checksum != nsvcd__body_checksum(b) || !nsvcd__body_is_sound(b))
    return NSVCD_ERROR_BODY;
  *body = b;
  return NSVCD_OK;
}

// Multiplies a body of triangles; one of latents without what is within it.
static void nsvcd__scale_part(nsvcd_body *b, float scale) {
  const size_t padded = b->padded;
  float *spheres = (float *)(b + 1);
  for (size_t i = 0; i < 3 * padded + b->patches; i++) spheres[i] *= scale;
  if (b->weights_id != 0) {
    float *areas = (float *)nsvcd__writable(b, nsvcd__body_areas(b));
    for (size_t i = 0; i < 3 * nsvcd__area_slots(padded); i++) {
      areas[i] *= scale;
      areas[i] *= scale;
    }
    nsvcd__cover_level(b, 0, nsvcd__body_patches(b), b->patches);
    nsvcd__body_finish(b);
    b->checksum = nsvcd__body_checksum(b);
    return;
  }
#ifndef NSVCD_NO_PROOF
  // What rounding does to a vertex goes to the slacks and quanta.
  const nsvcd__facets f = nsvcd__facets_of(b);
  const double by = (double)scale;
  float *discs = (float *)nsvcd__writable(b, f.discs);
  float *steps = (float *)nsvcd__writable(b, f.steps);
  float *slacks = (float *)nsvcd__writable(b, f.slacks);
  float *quanta = (float *)nsvcd__writable(b, f.quanta);
  float *seeds = (float *)nsvcd__writable(b, f.seeds);
  for (size_t i = 0; i < b->patches; i++) {
    const double distance = (double)nsvcd__f3_length(nsvcd__facet_centre(&f, i));
    nsvcd__disc disc = nsvcd__disc_at(f.discs, padded, i);
    steps[i] *= scale;
    const double rounding = 2e-7 * (distance + 6e4 * (double)steps[i]);
    slacks[i] = nsvcd__round_outward((double)slacks[i] * by + rounding);
    quanta[i] = nsvcd__round_outward((double)quanta[i] * by + rounding);
    disc.low = (float)((double)disc.low * by - rounding);
    disc.high = (float)((double)disc.high * by + rounding);
    disc.across = nsvcd__round_outward((double)disc.across * by + rounding);
    nsvcd__disc_store(disc, discs, padded, i);
  }
  for (size_t i = 0; i < 3 * f.components; i++) seeds[i] *= scale;
  void *counts = nsvcd__writable(b, nsvcd__counts_of(b));
  ((nsvcd__facet_counts *)counts)->round *= scale;
  nsvcd__facets_finish(b);
#endif
}

NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, float scale, void *memory,
                                       size_t capacity, const nsvcd_body **scaled) {
  if (!body || !memory || !scaled || !nsvcd__is_finite(scale) || scale <= 0)
    return NSVCD_ERROR_ARGUMENT;
  if (capacity < body->size || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
#ifdef NSVCD_NO_PROOF
  // The triangles would keep their size; nor were they looked at when the body was loaded.
  if (body->triangles) return NSVCD_ERROR_BODY;
#endif
  // Would it still be within the limits of nsvcd_body_load?
  const float radius = nsvcd__whole_radius(body);
  if (!nsvcd__spheres_fit(body, radius, scale)) return NSVCD_ERROR_ARGUMENT;
  const double most = (double)NSVCD__MAX_LENGTH / (double)scale;
  const size_t numbers = body->weights_id ? 3 * nsvcd__area_slots(body->padded) : 0;
  for (size_t i = 0; i < numbers; i++) {
    if (fabs((double)nsvcd__body_areas(body)[i]) > most * most) return NSVCD_ERROR_ARGUMENT;
  }
#ifndef NSVCD_NO_PROOF
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles && !nsvcd__spheres_fit(triangles, radius, scale)) return NSVCD_ERROR_ARGUMENT;
#endif
  // in place is allowed
  memmove(memory, body, body->size);
  nsvcd_body *b = (nsvcd_body *)memory;
#ifndef NSVCD_NO_PROOF
  if (b->inner) nsvcd__scale_part((nsvcd_body *)(void *)((char *)memory + b->inner), scale);
#endif
  nsvcd__scale_part(b, scale);
  *scaled = b;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body) {
  nsvcd_body_facts facts;
  memset(&facts, 0, sizeof facts);
  facts.size = body->size;
  facts.patches = body->patches;
  memcpy(facts.centre, body->centre, sizeof facts.centre);
  facts.radius = nsvcd__whole_radius(body);
  facts.latents = body->weights_id != 0;
  for (size_t i = 0; i < body->patches; i++)
    facts.mean_patch_radius += nsvcd__body_r(body)[i] / (float)body->patches;
#ifndef NSVCD_NO_PROOF
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles) {
    const nsvcd__facets f = nsvcd__facets_of(triangles);
    facts.triangles = triangles->triangles;
    facts.listings = f.listed;
    facts.quantum = nsvcd__widest_quantum(&f);
    facts.round = f.round;
  }
#endif
  return facts;
}

NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius) {
  if (!body || patch >= body->patches) return 0;
  const nsvcd__sphere sphere = nsvcd__sphere_of(nsvcd__body_patches(body), patch);
  nsvcd__f3_store(sphere.centre, centre);
  *radius = sphere.radius + nsvcd__whole_radius(body) - body->radius;
  return 1;
}

// ------------------------------------------------------------------------------------- body/encode
// In: a mesh. Out: a body. Region by region the surface becomes patches, and these become latents
// and triangles; then all of them become one blob, neighbours side by side.

#ifndef NSVCD_NO_ENCODER
// What a body is built of.
typedef struct nsvcd__parts {
  const nsvcd_mesh *mesh;
  // with the defaults filled in: `patches` is not 0, `latents` says whether there are to be any
  const nsvcd_encode_options *options;
  // of all the arrays
  nsvcd__arena arena;
  size_t count;        // N
  nsvcd__f3 *centres;  // (N)
  int in_runs;         // then they are in order
  // bytes; 0: without
  size_t latents_size, facets_size;
#ifndef NSVCD_NO_NETWORK
  // Of a body with latents, else empty:
  float *radii;      // (N)
  nsvcd__f3 *areas;  // (N)
  int8_t *latents;   // (N, LATENT)
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__surface surface;
  nsvcd__facet_counts counts;
#endif
} nsvcd__parts;

static int nsvcd__is_cancelled(const nsvcd_encode_options *options, double done) {
  return options->progress && options->progress((float)done, options->user);
}

// Adds the patches of region n, at most so many.
static nsvcd_result nsvcd__parts_add(nsvcd__parts *parts, nsvcd__regions *regions, size_t n,
                                     size_t most) {
  nsvcd__region region;
  nsvcd__patches patches;
  nsvcd__arena spare = nsvcd__arena_of(parts->arena.allocator);
  nsvcd_result result = nsvcd__region_begin(regions, n, &spare, &region);
  if (result == NSVCD_ERROR_EMPTY) return NSVCD_OK;
  if (!result) result = nsvcd__patches_build(&region.mesh, most, &spare, &patches);
  const size_t count = result ? 0 : patches.count;
  for (size_t i = 0; i < count; i++) parts->centres[parts->count + i] = patches.centres[i];
#ifndef NSVCD_NO_NETWORK
  for (size_t i = 0; parts->options->latents && i < count; i++) {
    const size_t to = parts->count + i;
    const float radius = patches.radii[i];
    const size_t first = patches.offsets[i];
    nsvcd__encoded patch;
    patch.samples = patches.samples + first;
    patch.normals = patches.normals + first;
    patch.count = patches.offsets[i + 1] - first;
    patch.centre = patches.centres[i];
    patch.inverse_radius = radius > 0 ? 1 / radius : 0;
    float latent[NSVCD__LATENT];
    nsvcd__encode_patch(&patch, latent);
    for (size_t k = 0; k < NSVCD__LATENT; k++)
      parts->latents[NSVCD__LATENT * to + k] = (int8_t)lrintf(127 * latent[k]);
    // The mesh has the cuts rounded: each coordinate by half a unit in the last place, at most. By
    // so much the surface may stick out of the balls.
    const double margin = 1.1e-7 * region.greatest;
    const double wider = ((double)radius + margin) * (1 + 1e-7);
    parts->radii[to] = region.cut_count > 0 ? (float)wider : radius;
    parts->areas[to] = patches.area_vectors[i];
  }
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__pieces pieces;
  if (!result && !parts->options->no_triangles) {
    result = NSVCD_ERROR_MEMORY;
    if (nsvcd__pieces_build(&region, &patches, &spare, &pieces))
      result = nsvcd__surface_add(&pieces, &spare, &parts->surface);
  }
#endif
  parts->count += count;
  if (!result) nsvcd__region_end(regions, &region);
  nsvcd__arena_free(&spare);
  return result;
}

#ifndef NSVCD_NO_PROOF
// All of a mesh that has points or segments, in runs, block by block. Without latents.
static nsvcd_result nsvcd__parts_of_runs(nsvcd__parts *parts) {
  const nsvcd_mesh *mesh = parts->mesh;
  const size_t triangles = mesh->triangle_count;
  const size_t wanted = parts->options->patches;
  const size_t runs = wanted < triangles ? wanted : triangles;
  nsvcd__arena spare = nsvcd__arena_of(parts->arena.allocator);
  nsvcd__surface *surface = &parts->surface;
  nsvcd__curve curve;
  int ok = nsvcd__surface_begin(runs, mesh->vertex_count, &parts->arena, surface);
  ok = ok && nsvcd__curve_build(mesh, parts->options->round, &spare, &curve);
  ok = ok && nsvcd__surface_room(surface, mesh->vertex_count, triangles);
  nsvcd_result result = ok ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  for (size_t first = 0; !result && first < runs; first = surface->done) {
    const size_t left = runs - first;
    const size_t last = first + (left < NSVCD__RUNS_AT_ONCE ? left : NSVCD__RUNS_AT_ONCE);
    nsvcd__region block;
    nsvcd__patches patches;
    nsvcd__pieces pieces;
    nsvcd__arena few = nsvcd__arena_of(spare.allocator);
    ok = nsvcd__runs_build(&curve, first, last, runs, &few, &block, &patches, &pieces);
    result = ok ? nsvcd__surface_add(&pieces, &few, surface) : NSVCD_ERROR_MEMORY;
    nsvcd__arena_free(&few);
    const double done = (double)last / (double)runs;
    if (!result && nsvcd__is_cancelled(parts->options, 0.9 * done))
      result = NSVCD_ERROR_CANCELLED;
  }
  parts->count = runs;
  nsvcd__arena_free(&spare);
  return result;
}
#endif

// All of it, region by region.
static nsvcd_result nsvcd__parts_of_regions(nsvcd__parts *parts) {
  const nsvcd_encode_options *options = parts->options;
  const size_t patches = options->patches;
  nsvcd__arena *arena = &parts->arena;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  nsvcd__regions regions;
  if (!nsvcd__regions_build(parts->mesh, patches, &spare, &regions)) {
    nsvcd__arena_free(&spare);
    return NSVCD_ERROR_MEMORY;
  }
  parts->centres = NSVCD__TAKE(arena, nsvcd__f3, patches);
#ifndef NSVCD_NO_NETWORK
  const size_t latents = options->latents ? patches : 0;
  parts->radii = NSVCD__TAKE(arena, float, latents);
  parts->areas = NSVCD__TAKE(arena, nsvcd__f3, latents);
  parts->latents = NSVCD__TAKE(arena, int8_t, NSVCD__LATENT * latents);
#endif
#ifndef NSVCD_NO_PROOF
  if (!options->no_triangles)
    (void)nsvcd__surface_begin(patches, regions.component_count, arena, &parts->surface);
#endif
  const size_t count = regions.count;
  nsvcd_result result = arena->failed ? NSVCD_ERROR_MEMORY : NSVCD_OK;
  for (size_t n = 0; !result && n < count; n++) {
    const size_t most = patches * (n + 1) / count - patches * n / count;
    const double done = (double)(n + 1) / (double)(count + 2);
    const int stop = nsvcd__is_cancelled(options, done);
    result = stop ? NSVCD_ERROR_CANCELLED : nsvcd__parts_add(parts, &regions, n, most);
  }
  nsvcd__arena_free(&spare);
  return result;
}

// Everything but the blob. On success release with nsvcd__arena_free. MEMORY, CANCELLED, TOO_LARGE.
static nsvcd_result nsvcd__parts_build(const nsvcd_mesh *mesh,
                                       const nsvcd_encode_options *options,
                                       const nsvcd_allocator *allocator, nsvcd__parts *parts) {
  memset(parts, 0, sizeof *parts);
  parts->mesh = mesh;
  parts->options = options;
  parts->arena = nsvcd__arena_of(allocator);
  if (nsvcd__is_cancelled(options, 0)) return NSVCD_ERROR_CANCELLED;
  nsvcd_result result = NSVCD_OK;
#ifndef NSVCD_NO_PROOF
  parts->in_runs = options->round > 0 && nsvcd__has_points(mesh);
  if (parts->in_runs) result = nsvcd__parts_of_runs(parts);
#endif
  if (!parts->in_runs) result = nsvcd__parts_of_regions(parts);
#ifndef NSVCD_NO_NETWORK
  if (!result && options->latents) parts->latents_size = nsvcd_body_size(parts->count);
#endif
#ifndef NSVCD_NO_PROOF
  if (!result && !options->no_triangles) {
    nsvcd__facets none;
    parts->counts = nsvcd__facets_count(&parts->surface);
    parts->counts.round = options->round;
    parts->facets_size = nsvcd__facets_lay(NULL, parts->count, &parts->counts, &none);
    if (!parts->facets_size) result = NSVCD_ERROR_TOO_LARGE;
  }
#endif
  if (result) nsvcd__arena_free(&parts->arena);
  return result;
}

// Puts the patches in order and writes the blob, (latents_size + facets_size) bytes: the body of
// latents, then the body of triangles. MEMORY, NUMBER, EMPTY.
static nsvcd_result nsvcd__parts_write(nsvcd__parts *parts, void *memory) {
  const size_t count = parts->count;
  const size_t triangles = parts->mesh->triangle_count;
  const int open = parts->options->open;
  nsvcd_body *b = (nsvcd_body *)memory;
  uint16_t *order = NSVCD__TAKE(&parts->arena, uint16_t, 2 * count);
  if (!order) return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < count; i++) order[i] = (uint16_t)i;
  const nsvcd__ordering all = {parts->centres, order, order + count, count};
  if (!parts->in_runs) nsvcd__body_order(all);
  nsvcd_result result = NSVCD_OK;
#ifndef NSVCD_NO_NETWORK
  if (parts->latents_size) {
    nsvcd__latents_source source;
    source.count = count;
    source.centres = parts->centres;
    source.radii = parts->radii;
    source.areas = parts->areas;
    source.latents = parts->latents;
    source.order = order;
    source.open = open;
    result = nsvcd__body_build(&source, memory);
  }
#endif
#ifndef NSVCD_NO_PROOF
  if (!result && parts->facets_size) {
    void *to = (char *)memory + parts->latents_size;
    result = nsvcd__facets_build(&parts->surface, &parts->counts, triangles, order, open, to,
                                 parts->facets_size);
  }
#endif
  if (result || !parts->latents_size || !parts->facets_size) return result;
  b->triangles = (uint32_t)triangles;
  b->inner = (uint32_t)parts->latents_size;
  b->size = (uint32_t)(parts->latents_size + parts->facets_size);
  b->checksum = nsvcd__body_checksum(b);
  return NSVCD_OK;
}

// How many patches, where the options do not say. area: of the mesh, square metres.
static size_t nsvcd__patches_for(const nsvcd_mesh *mesh, float patch_radius, double area,
                                 int triangles) {
  const double most = NSVCD_MAX_PATCHES;
  if (patch_radius > 0) {
    // N balls of radius r cover about N r^2 / 0.45 of surface: measured, on the real meshes, for N
    // = 32 to 512.
    const double square = (double)patch_radius * (double)patch_radius;
    const double count = ceil(0.45 * area / square);
    return (size_t)fmin(fmax(count, 1), most);
  }
  if (!triangles) return NSVCD_DEFAULT_NETWORK_PATCHES;
  if (mesh->triangle_count <= NSVCD_LEAST_PATCHES) return NSVCD_LEAST_PATCHES;
  if (mesh->triangle_count <= NSVCD_VERY_FEW_TRIANGLES) return mesh->triangle_count;
  if (mesh->triangle_count <= NSVCD_FEW_TRIANGLES) return NSVCD_DEFAULT_PATCHES;
  if (mesh->triangle_count <= NSVCD_MANY_TRIANGLES) return NSVCD_SMALL_PATCHES;
  const size_t fine = mesh->triangle_count / NSVCD_LEVEL_TRIANGLES;
  return fine < NSVCD_MAX_PATCHES ? fine : NSVCD_MAX_PATCHES;
}

// Checks options and mesh, and fills in the defaults.
static nsvcd_result nsvcd__encode_settle(const nsvcd_mesh *mesh, nsvcd_encode_options *o) {
#ifdef NSVCD_NO_PROOF
  o->no_triangles = 1;
#endif
  if (o->no_triangles) o->latents = 1;
#ifdef NSVCD_NO_NETWORK
  if (o->latents) return NSVCD_ERROR_ARGUMENT;
#endif
  if (!nsvcd__is_finite(o->patch_radius) || o->patch_radius < 0) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__within(&o->round, 1, NSVCD_MAX_COORDINATE) || o->round < 0)
    return NSVCD_ERROR_ARGUMENT;
  if (o->round > 0 && o->latents) return NSVCD_ERROR_ARGUMENT;
  if (o->patches > NSVCD_MAX_PATCHES) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result checked = mesh->indices ? nsvcd__mesh_check(mesh) : NSVCD_OK;
  if (checked) return checked;
#ifndef NSVCD_NO_PROOF
  if (o->patches == 0 && o->round > 0 && nsvcd__has_points(mesh))
    o->patches = nsvcd__runs_for(mesh);
#endif
  if (o->patches > 0 && o->round > 0) return NSVCD_OK;
  const double area = nsvcd__mesh_area(mesh);
  if (!(area > 0) && !(o->round > 0)) return NSVCD_ERROR_EMPTY;
  if (o->patches == 0)
    o->patches = nsvcd__patches_for(mesh, o->patch_radius, area, !o->no_triangles);
  return NSVCD_OK;
}

// nsvcd_encode of a mesh, or of a cloud that has been checked: a mesh without indices, of which
// triangle t is point t.
static nsvcd_result nsvcd__encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                  const nsvcd_allocator *allocator, void *memory,
                                  size_t capacity, const nsvcd_body **body) {
  if (!body) return NSVCD_ERROR_ARGUMENT;
  if (memory && !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_encode_options o;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  nsvcd__parts parts;
  nsvcd_result result = nsvcd__encode_settle(mesh, &o);
  if (!result) result = nsvcd__parts_build(mesh, &o, allocator, &parts);
  if (result) return result;

  const int fits = parts.facets_size <= 0xffffffffu - parts.latents_size;
  const size_t size = parts.latents_size + parts.facets_size;
  void *to = memory || !fits ? memory : nsvcd__alloc(allocator, size);
  if (!fits) {
    result = NSVCD_ERROR_TOO_LARGE;
  } else if (!to) {
    result = NSVCD_ERROR_MEMORY;
  } else if ((memory && capacity < size) || !nsvcd__is_aligned(to)) {
    result = NSVCD_ERROR_WORKSPACE;
  } else {
    result = nsvcd__parts_write(&parts, to);
  }
  if (!result) *body = (const nsvcd_body *)to;
  if (result && !memory) nsvcd__free(allocator, to);
  nsvcd__arena_free(&parts.arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *allocator, void *memory,
                                   size_t capacity, const nsvcd_body **body) {
  if (!mesh || !mesh->indices) return nsvcd__mesh_check(mesh);
  return nsvcd__encode(mesh, options, allocator, memory, capacity, body);
}

NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *allocator) {
  void *memory;
  // a cast would take away a const
  memcpy(&memory, &body, sizeof memory);
  nsvcd__free(allocator, memory);
}
#endif  // NSVCD_NO_ENCODER

// ------------------------------------------------------------------------------------- body/shapes
// In: a shape in numbers. Out: its body: a skeleton of points, segments or a box, and how round it
// is.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
static nsvcd_result nsvcd__encode_round(const nsvcd_mesh *mesh, float round,
                                        const nsvcd_allocator *allocator,
                                        const nsvcd_body **body) {
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.round = round;
  return nsvcd__encode(mesh, &options, allocator, NULL, 0, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_sphere(float radius, const nsvcd_allocator *allocator,
                                          const nsvcd_body **body) {
  float centre[3] = {0, 0, 0};
  uint32_t point[3] = {0, 0, 0};
  const nsvcd_mesh mesh = {centre, point, 1, 1};
  if (!(radius > 0)) return NSVCD_ERROR_ARGUMENT;
  return nsvcd__encode_round(&mesh, radius, allocator, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_capsule(const float from[3], const float to[3],
                                           float radius, const nsvcd_allocator *allocator,
                                           const nsvcd_body **body) {
  float ends[6];
  uint32_t segment[3] = {0, 1, 1};
  const nsvcd_mesh mesh = {ends, segment, 2, 1};
  if (!from || !to || !(radius > 0)) return NSVCD_ERROR_ARGUMENT;
  memcpy(ends, from, 3 * sizeof *from);
  memcpy(ends + 3, to, 3 * sizeof *to);
  return nsvcd__encode_round(&mesh, radius, allocator, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_box(const float half[3], float round,
                                       const nsvcd_allocator *allocator,
                                       const nsvcd_body **body) {
  // corner n is on the far side of axis k if bit k of n is set
  uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  float corners[24];
  const nsvcd_mesh mesh = {corners, faces, 8, 12};
  if (!half || !(round >= 0)) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 3; k++) {
    if (!(half[k] > 0) || !(half[k] >= round)) return NSVCD_ERROR_ARGUMENT;
    for (size_t n = 0; n < 8; n++)
      corners[3 * n + k] = n >> k & 1 ? half[k] - round : round - half[k];
  }
  return nsvcd__encode_round(&mesh, round, allocator, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_cloud(const float *points, size_t count, float radius,
                                         const nsvcd_allocator *allocator,
                                         const nsvcd_body **body) {
  nsvcd_mesh mesh = {NULL, NULL, count, count};
  if (!points || !(radius > 0)) return NSVCD_ERROR_ARGUMENT;
  if (count == 0) return NSVCD_ERROR_EMPTY;
  if (count > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  if (!nsvcd__within(points, 3 * count, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  // a cast would take away a const; nothing is written
  memcpy(&mesh.positions, &points, sizeof points);
  return nsvcd__encode_round(&mesh, radius, allocator, body);
}
#endif

#endif  // NSVCD__ISA

// ===================================================================== lanes: 16 numbers at a time

// ------------------------------------------------------------------------------------- lanes/lanes
// In, out: a slice of 16 lanes: as many floats as a register holds. v is such a slice, v3 a vector
// of three, lane by lane.

// ---- what each set of instructions calls its operations; what they mean, plain C says. Names, not
// functions, so that the sets of x86 are one text: entry/processor takes it in three times.

#undef NSVCD__OP
#undef NSVCD__OF_ALL
#undef NSVCD__FMA
#undef NSVCD__LE
#undef NSVCD__LT
#undef NSVCD__BITS
#undef NSVCD__SELECT

#if NSVCD__SLICE == 1
typedef float nsvcd__v;
#define nsvcd__v_load(p) (*(p))
#define nsvcd__v_store(p, a) (*(p) = (a))
#define nsvcd__v_set(x) ((float)(x))
#define nsvcd__v_add(a, b) ((float)((a) + (b)))
#define nsvcd__v_sub(a, b) ((float)((a) - (b)))
#define nsvcd__v_mul(a, b) ((float)((a) * (b)))
#define nsvcd__v_div(a, b) ((float)((a) / (b)))
#define NSVCD__MIN(a, b) (a < b ? a : b)
#define NSVCD__MAX(a, b) (a > b ? a : b)
#define nsvcd__v_sqrt sqrtf
#define NSVCD__LE(a, b) ((a) <= (b))
#define NSVCD__LT(a, b) ((a) < (b))
#define NSVCD__BITS(mask) (mask)
#define NSVCD__SELECT(mask, x, y) (mask ? x : y)
#else
#define nsvcd__v_add NSVCD__OP(add)
#define nsvcd__v_sub NSVCD__OP(sub)
#define nsvcd__v_mul NSVCD__OP(mul)
#define nsvcd__v_div NSVCD__OP(div)
#endif

#if defined(__wasm_simd128__) && NSVCD__SLICE == 4
typedef v128_t nsvcd__v;
#define NSVCD__OP(name) wasm_f32x4_##name
#define nsvcd__v_load wasm_v128_load
#define nsvcd__v_store wasm_v128_store
#define nsvcd__v_set NSVCD__OP(splat)
// pmin(b, a) is a < b ? a : b, one instruction of x86; min, which minds NaN and -0, is many.
#define NSVCD__MIN(a, b) NSVCD__OP(pmin)(b, a)
#define NSVCD__MAX(a, b) NSVCD__OP(pmax)(b, a)
#define nsvcd__v_sqrt NSVCD__OP(sqrt)
#define NSVCD__LE(a, b) NSVCD__OP(le)(a, b)
#define NSVCD__LT(a, b) NSVCD__OP(lt)(a, b)
#define NSVCD__BITS(mask) wasm_i32x4_bitmask(mask)
#define NSVCD__SELECT(mask, x, y) wasm_v128_bitselect(x, y, mask)

#elif defined(__aarch64__) && NSVCD__SLICE == 4
typedef float32x4_t nsvcd__v;
#define NSVCD__OP(name) v##name##q_f32
#define nsvcd__v_load vld1q_f32
#define nsvcd__v_store vst1q_f32
#define nsvcd__v_set vdupq_n_f32
#define NSVCD__FMA(a, b, c) vfmaq_f32(c, a, b)
#define NSVCD__MIN(a, b) NSVCD__OP(min)(a, b)
#define NSVCD__MAX(a, b) NSVCD__OP(max)(a, b)
#define nsvcd__v_sqrt NSVCD__OP(sqrt)
#define NSVCD__LE(a, b) NSVCD__OP(cle)(a, b)
#define NSVCD__LT(a, b) NSVCD__OP(clt)(a, b)
#define NSVCD__BITS(mask) nsvcd__v_bits(mask)
#define NSVCD__SELECT(mask, x, y) NSVCD__OP(bsl)(mask, x, y)
static inline uint32_t nsvcd__v_bits(uint32x4_t lanes) {
  static const uint32_t bit[4] = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(lanes, vld1q_u32(bit)));
}

#elif NSVCD__SLICE > 1  // x86
#define nsvcd__v_load NSVCD__OP(loadu)
#define nsvcd__v_store NSVCD__OP(storeu)
#define nsvcd__v_set NSVCD__OP(set1)
#define NSVCD__MIN(a, b) NSVCD__OF_ALL(min, a, b)
#define NSVCD__MAX(a, b) NSVCD__OF_ALL(max, a, b)
#define nsvcd__v_sqrt(a) NSVCD__OF_ALL(sqrt, a)
#endif

#if NSVCD__SLICE == 16
typedef __m512 nsvcd__v;
#define NSVCD__OP(name) _mm512_##name##_ps
// Masked, by a mask that takes all: without one gcc's own header warns, in C++.
#define NSVCD__ALL ((__mmask16)0xffff)
#define NSVCD__OF_ALL(name, ...) _mm512_maskz_##name##_ps(NSVCD__ALL, __VA_ARGS__)
#define NSVCD__FMA(a, b, c) _mm512_fmadd_ps(a, b, c)
#define NSVCD__LE(a, b) _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ)
#define NSVCD__LT(a, b) _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ)
#define NSVCD__BITS(mask) mask
#define NSVCD__SELECT(mask, x, y) _mm512_mask_blend_ps(mask, y, x)
#elif NSVCD__SLICE == 8
typedef __m256 nsvcd__v;
#define NSVCD__OP(name) _mm256_##name##_ps
#define NSVCD__OF_ALL(name, ...) _mm256_##name##_ps(__VA_ARGS__)
#define NSVCD__FMA(a, b, c) _mm256_fmadd_ps(a, b, c)
#define NSVCD__LE(a, b) _mm256_cmp_ps(a, b, _CMP_LE_OQ)
#define NSVCD__LT(a, b) _mm256_cmp_ps(a, b, _CMP_LT_OQ)
#define NSVCD__BITS(mask) _mm256_movemask_ps(mask)
#define NSVCD__SELECT(mask, x, y) _mm256_blendv_ps(y, x, mask)
#elif NSVCD__SLICE == 4 && !defined(NSVCD__OP)
typedef __m128 nsvcd__v;
#define NSVCD__OP(name) _mm_##name##_ps
#define NSVCD__OF_ALL(name, ...) _mm_##name##_ps(__VA_ARGS__)
#define NSVCD__LE(a, b) _mm_cmple_ps(a, b)
#define NSVCD__LT(a, b) _mm_cmplt_ps(a, b)
#define NSVCD__BITS(mask) _mm_movemask_ps(mask)
#define NSVCD__SELECT(mask, x, y) _mm_or_ps(_mm_and_ps(mask, x), _mm_andnot_ps(mask, y))
#endif

#ifdef NSVCD_ONE_PATH
#undef NSVCD__FMA
#endif
#ifndef NSVCD__FMA
#define NSVCD__FMA(a, b, c) nsvcd__v_add(nsvcd__v_mul(a, b), c)
#endif
#define nsvcd__v_fma(a, b, c) NSVCD__FMA(a, b, c)  // a b + c
// Bit i is set where a <= b in lane i of the slice, or a < b.
#define nsvcd__v_le(a, b) ((uint32_t)NSVCD__BITS(NSVCD__LE(a, b)))
#define nsvcd__v_lt(a, b) ((uint32_t)NSVCD__BITS(NSVCD__LT(a, b)))
static inline nsvcd__v nsvcd__v_min(nsvcd__v a, nsvcd__v b) {
  return NSVCD__MIN(a, b);
}
static inline nsvcd__v nsvcd__v_max(nsvcd__v a, nsvcd__v b) {
  return NSVCD__MAX(a, b);
}
// a <= b ? x : y.
static inline nsvcd__v nsvcd__v_pick(nsvcd__v a, nsvcd__v b, nsvcd__v x, nsvcd__v y) {
  return NSVCD__SELECT(NSVCD__LE(a, b), x, y);
}
// The least of all lanes.
static inline float nsvcd__v_least(nsvcd__v a) {
#if NSVCD__SLICE == 1
  return a;
#elif defined(__aarch64__)
  return vminvq_f32(a);
#elif defined(__wasm_simd128__)
  const nsvcd__v two = nsvcd__v_min(a, wasm_i32x4_shuffle(a, a, 2, 3, 0, 1));
  return wasm_f32x4_extract_lane(nsvcd__v_min(two, wasm_i32x4_shuffle(two, two, 1, 0, 3, 2)),
                                 0);
#else
#if NSVCD__SLICE == 4
  const __m128 four = a;
#else
#if NSVCD__SLICE == 8
  const __m256 eight = a;
#else
  const __m512d whole = _mm512_castps_pd(a);
  const __m256d low = _mm512_maskz_extractf64x4_pd(0xf, whole, 0);
  const __m256d high = _mm512_maskz_extractf64x4_pd(0xf, whole, 1);
  const __m256 eight = _mm256_min_ps(_mm256_castpd_ps(low), _mm256_castpd_ps(high));
#endif
  const __m128 four =
      _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
#endif
  const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
#endif
}
static inline nsvcd__v nsvcd__v_load_int16(const int16_t *p) {
#if NSVCD__SLICE == 1
  return (float)*p;
#elif defined(__aarch64__)
  return vcvtq_f32_s32(vmovl_s16(vld1_s16(p)));
#elif defined(__wasm_simd128__)
  return wasm_f32x4_convert_i32x4(wasm_i32x4_load16x4(p));
#elif NSVCD__SLICE == 4
  const __m128i packed = _mm_loadl_epi64((const __m128i *)(const void *)p);
  return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(packed, packed), 16));
#elif NSVCD__SLICE == 8
  const __m128i packed = _mm_loadu_si128((const __m128i *)(const void *)p);
  return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(packed));
#else
  const __m256i packed = _mm256_loadu_si256((const __m256i *)(const void *)p);
  const __m512i wide = _mm512_maskz_cvtepi16_epi32(NSVCD__ALL, packed);
  return _mm512_maskz_cvtepi32_ps(NSVCD__ALL, wide);
#endif
}

#define NSVCD__SLICE_MASK (((uint32_t)1 << (NSVCD__SLICE - 1) << 1) - 1)
#define NSVCD__EACH_SLICE(l) for (size_t l = 0; l < NSVCD__LANES; l += NSVCD__SLICE)

static inline nsvcd__v nsvcd__v_clamp(nsvcd__v a, float low, float high) {
  return nsvcd__v_min(nsvcd__v_max(a, nsvcd__v_set(low)), nsvcd__v_set(high));
}
// All lanes times a number, and plus a number.
static inline nsvcd__v nsvcd__v_scale(nsvcd__v a, float s) {
  return nsvcd__v_mul(a, nsvcd__v_set(s));
}
static inline nsvcd__v nsvcd__v_plus(nsvcd__v a, float s) {
  return nsvcd__v_add(a, nsvcd__v_set(s));
}
static inline nsvcd__v nsvcd__v_negate(nsvcd__v a) {
  return nsvcd__v_sub(nsvcd__v_set(0), a);
}

static inline nsvcd__v nsvcd__v_abs(nsvcd__v a) {
  return nsvcd__v_max(a, nsvcd__v_negate(a));
}

// A slice of vectors as a value, lane by lane.
typedef struct nsvcd__v3 {
  nsvcd__v x, y, z;
} nsvcd__v3;

NSVCD__INLINE nsvcd__v3 nsvcd__v3_of(nsvcd__v x, nsvcd__v y, nsvcd__v z) {
  const nsvcd__v3 out = {x, y, z};
  return out;
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_set(nsvcd__f3 a) {
  return nsvcd__v3_of(nsvcd__v_set(a.x), nsvcd__v_set(a.y), nsvcd__v_set(a.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_add(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_add(a.x, b.x), nsvcd__v_add(a.y, b.y), nsvcd__v_add(a.z, b.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_sub(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_sub(a.x, b.x), nsvcd__v_sub(a.y, b.y), nsvcd__v_sub(a.z, b.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_negate(nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v_negate(a.x), nsvcd__v_negate(a.y), nsvcd__v_negate(a.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_min(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_min(a.x, b.x), nsvcd__v_min(a.y, b.y), nsvcd__v_min(a.z, b.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_max(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_max(a.x, b.x), nsvcd__v_max(a.y, b.y), nsvcd__v_max(a.z, b.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_scale(nsvcd__v3 a, nsvcd__v s) {
  return nsvcd__v3_of(nsvcd__v_mul(s, a.x), nsvcd__v_mul(s, a.y), nsvcd__v_mul(s, a.z));
}
// a + s b.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_fma(nsvcd__v s, nsvcd__v3 b, nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v_fma(s, b.x, a.x), nsvcd__v_fma(s, b.y, a.y),
                      nsvcd__v_fma(s, b.z, a.z));
}
NSVCD__INLINE nsvcd__v nsvcd__v3_dot(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v_fma(a.x, b.x, nsvcd__v_fma(a.y, b.y, nsvcd__v_mul(a.z, b.z)));
}
// s + a b.
NSVCD__INLINE nsvcd__v nsvcd__v3_dot_add(nsvcd__v3 a, nsvcd__v3 b, nsvcd__v s) {
  const nsvcd__v sum = nsvcd__v_fma(a.x, b.x, s);
  return nsvcd__v_fma(a.z, b.z, nsvcd__v_fma(a.y, b.y, sum));
}
NSVCD__INLINE nsvcd__v nsvcd__v3_length(nsvcd__v3 a) {
  return nsvcd__v_sqrt(nsvcd__v3_dot(a, a));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_cross(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_sub(nsvcd__v_mul(a.y, b.z), nsvcd__v_mul(a.z, b.y)),
                      nsvcd__v_sub(nsvcd__v_mul(a.z, b.x), nsvcd__v_mul(a.x, b.z)),
                      nsvcd__v_sub(nsvcd__v_mul(a.x, b.y), nsvcd__v_mul(a.y, b.x)));
}
// The centres of a slice of spheres, from l on.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_centres(nsvcd__spheres all, size_t l) {
  return nsvcd__v3_of(nsvcd__v_load(all.x + l), nsvcd__v_load(all.y + l),
                      nsvcd__v_load(all.z + l));
}
// Rows of x, y and z, so many numbers apart.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_load_rows(const float *p, size_t stride) {
  return nsvcd__v3_of(nsvcd__v_load(p), nsvcd__v_load(p + stride),
                      nsvcd__v_load(p + 2 * stride));
}
NSVCD__INLINE void nsvcd__v3_store_rows(nsvcd__v3 a, float *p, size_t stride) {
  nsvcd__v_store(p, a.x);
  nsvcd__v_store(p + stride, a.y);
  nsvcd__v_store(p + 2 * stride, a.z);
}
// From three rows of 16 numbers.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_rows(const float *p) {
  return nsvcd__v3_load_rows(p, NSVCD__LANES);
}
// Lanes l .. l + SLICE - 1 of p (3, LANES).
NSVCD__INLINE void nsvcd__v3_store(float (*p)[NSVCD__LANES], size_t l, nsvcd__v3 a) {
  nsvcd__v3_store_rows(a, p[0] + l, NSVCD__LANES);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_load(float (*p)[NSVCD__LANES], size_t l) {
  return nsvcd__v3_load_rows(p[0] + l, NSVCD__LANES);
}

// One lane alone: the vector in lane l of (3, LANES).
static inline nsvcd__f3 nsvcd__lane_of(float (*lanes)[NSVCD__LANES], size_t l) {
  return nsvcd__f3_get(lanes[0] + l, NSVCD__LANES);
}
static inline void nsvcd__lane_set(nsvcd__f3 a, float (*lanes)[NSVCD__LANES], size_t l) {
  nsvcd__f3_put(a, lanes[0] + l, NSVCD__LANES);
}
// Vectors over their lengths; the x axis where that is 0.
static inline nsvcd__v3 nsvcd__v3_unit(nsvcd__v3 a) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v least = nsvcd__v_set(1e-18f);
  const nsvcd__v length = nsvcd__v3_length(a);
  const nsvcd__v inverse = nsvcd__v_div(one, nsvcd__v_max(length, least));
  const nsvcd__v3 unit = nsvcd__v3_scale(a, inverse);
  return nsvcd__v3_of(nsvcd__v_pick(length, least, one, unit.x),
                      nsvcd__v_pick(length, least, zero, unit.y),
                      nsvcd__v_pick(length, least, zero, unit.z));
}

// ------------------------------------------------------------------------------------- lanes/turns
// In, out: rotations, lane by lane: vquat and vmat3 are a slice of quaternions and of matrices.

typedef struct nsvcd__vquat {
  nsvcd__v x, y, z, w;
} nsvcd__vquat;

// Matrices by their rows.
typedef struct nsvcd__vmat3 {
  nsvcd__v3 x, y, z;
} nsvcd__vmat3;

NSVCD__INLINE nsvcd__vquat nsvcd__vquat_of(nsvcd__v3 axis, nsvcd__v w) {
  const nsvcd__vquat out = {axis.x, axis.y, axis.z, w};
  return out;
}
// times the sine of half the angle
NSVCD__INLINE nsvcd__v3 nsvcd__vquat_axis(nsvcd__vquat q) {
  return nsvcd__v3_of(q.x, q.y, q.z);
}
NSVCD__INLINE nsvcd__vquat nsvcd__vquat_set(nsvcd__quat q) {
  return nsvcd__vquat_of(nsvcd__v3_set(nsvcd__f3_of(q.x, q.y, q.z)), nsvcd__v_set(q.w));
}
// Rows of x, y, z and w, so many numbers apart.
NSVCD__INLINE nsvcd__vquat nsvcd__vquat_load(const float *p, size_t stride) {
  return nsvcd__vquat_of(nsvcd__v3_load_rows(p, stride), nsvcd__v_load(p + 3 * stride));
}
NSVCD__INLINE void nsvcd__vquat_store(nsvcd__vquat q, float *p, size_t stride) {
  nsvcd__v3_store_rows(nsvcd__vquat_axis(q), p, stride);
  nsvcd__v_store(p + 3 * stride, q.w);
}
static inline nsvcd__v nsvcd__vquat_dot(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v sum = nsvcd__v_fma(a.y, b.y, nsvcd__v_mul(a.x, b.x));
  return nsvcd__v_fma(a.w, b.w, nsvcd__v_fma(a.z, b.z, sum));
}
// a + s b.
static inline nsvcd__vquat nsvcd__vquat_fma(nsvcd__v s, nsvcd__vquat b, nsvcd__vquat a) {
  return nsvcd__vquat_of(nsvcd__v3_fma(s, nsvcd__vquat_axis(b), nsvcd__vquat_axis(a)),
                         nsvcd__v_fma(s, b.w, a.w));
}
static inline nsvcd__vquat nsvcd__vquat_unit(nsvcd__vquat q) {
  const nsvcd__v length = nsvcd__v_sqrt(nsvcd__vquat_dot(q, q));
  const nsvcd__vquat out = {nsvcd__v_div(q.x, length), nsvcd__v_div(q.y, length),
                            nsvcd__v_div(q.z, length), nsvcd__v_div(q.w, length)};
  return out;
}
// of unit ones
static inline nsvcd__vquat nsvcd__vquat_inverse(nsvcd__vquat q) {
  return nsvcd__vquat_of(nsvcd__v3_negate(nsvcd__vquat_axis(q)), q.w);
}
static inline nsvcd__vquat nsvcd__vquat_mul(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v3 u = nsvcd__vquat_axis(a);
  const nsvcd__v3 v = nsvcd__vquat_axis(b);
  const nsvcd__v3 along = nsvcd__v3_fma(a.w, v, nsvcd__v3_scale(u, b.w));
  const nsvcd__v cosines = nsvcd__v_mul(a.w, b.w);
  return nsvcd__vquat_of(nsvcd__v3_add(nsvcd__v3_cross(u, v), along),
                         nsvcd__v_sub(cosines, nsvcd__v3_dot(u, v)));
}

NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_rows(nsvcd__v3 x, nsvcd__v3 y, nsvcd__v3 z) {
  const nsvcd__vmat3 out = {x, y, z};
  return out;
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_set(const nsvcd__mat3 *m) {
  return nsvcd__vmat3_rows(nsvcd__v3_set(m->x), nsvcd__v3_set(m->y), nsvcd__v3_set(m->z));
}
// The matrix in lane l of p (9, LANES), row-major.
static inline nsvcd__mat3 nsvcd__mat3_lane(float (*p)[NSVCD__LANES], size_t l) {
  const nsvcd__mat3 out = {nsvcd__lane_of(p, l), nsvcd__lane_of(p + 3, l),
                           nsvcd__lane_of(p + 6, l)};
  return out;
}
// p: (9, LANES), row-major.
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_load(float (*p)[NSVCD__LANES], size_t l) {
  return nsvcd__vmat3_rows(nsvcd__v3_load(p, l), nsvcd__v3_load(p + 3, l),
                           nsvcd__v3_load(p + 6, l));
}
NSVCD__INLINE void nsvcd__vmat3_store(float (*p)[NSVCD__LANES], size_t l, nsvcd__vmat3 m) {
  nsvcd__v3_store(p, l, m.x);
  nsvcd__v3_store(p + 3, l, m.y);
  nsvcd__v3_store(p + 6, l, m.z);
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_scale(nsvcd__vmat3 m, nsvcd__v s) {
  return nsvcd__vmat3_rows(nsvcd__v3_scale(m.x, s), nsvcd__v3_scale(m.y, s),
                           nsvcd__v3_scale(m.z, s));
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_sub(nsvcd__vmat3 a, nsvcd__vmat3 b) {
  return nsvcd__vmat3_rows(nsvcd__v3_sub(a.x, b.x), nsvcd__v3_sub(a.y, b.y),
                           nsvcd__v3_sub(a.z, b.z));
}
// a + s b.
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_fma(nsvcd__v s, nsvcd__vmat3 b, nsvcd__vmat3 a) {
  return nsvcd__vmat3_rows(nsvcd__v3_fma(s, b.x, a.x), nsvcd__v3_fma(s, b.y, a.y),
                           nsvcd__v3_fma(s, b.z, a.z));
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_transpose(nsvcd__vmat3 m) {
  return nsvcd__vmat3_rows(nsvcd__v3_of(m.x.x, m.y.x, m.z.x),
                           nsvcd__v3_of(m.x.y, m.y.y, m.z.y),
                           nsvcd__v3_of(m.x.z, m.y.z, m.z.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__vmat3_apply(nsvcd__vmat3 m, nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v3_dot(m.x, a), nsvcd__v3_dot(m.y, a), nsvcd__v3_dot(m.z, a));
}
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_mul(nsvcd__vmat3 a, nsvcd__vmat3 b) {
  const nsvcd__vmat3 columns = nsvcd__vmat3_transpose(b);
  return nsvcd__vmat3_rows(nsvcd__vmat3_apply(columns, a.x), nsvcd__vmat3_apply(columns, a.y),
                           nsvcd__vmat3_apply(columns, a.z));
}
// p + m a.
NSVCD__INLINE nsvcd__v3 nsvcd__vmat3_apply_add(nsvcd__vmat3 m, nsvcd__v3 a, nsvcd__v3 p) {
  return nsvcd__v3_of(nsvcd__v3_dot_add(m.x, a, p.x), nsvcd__v3_dot_add(m.y, a, p.y),
                      nsvcd__v3_dot_add(m.z, a, p.z));
}
// The sum of the squares of the entries.
NSVCD__INLINE nsvcd__v nsvcd__vmat3_square(nsvcd__vmat3 m) {
  const nsvcd__v sum = nsvcd__v3_dot_add(m.x, m.x, nsvcd__v_set(0));
  return nsvcd__v3_dot_add(m.z, m.z, nsvcd__v3_dot_add(m.y, m.y, sum));
}
// The transpose of m, times a.
NSVCD__INLINE nsvcd__v3 nsvcd__vmat3_apply_transpose(nsvcd__vmat3 m, nsvcd__v3 a) {
  return nsvcd__v3_fma(a.z, m.z, nsvcd__v3_fma(a.y, m.y, nsvcd__v3_scale(m.x, a.x)));
}
// One rotation and position for all lanes.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_transform(const nsvcd__transform *t, nsvcd__v3 a) {
  const nsvcd__mat3 columns = nsvcd__mat3_transpose(t->rotation);
  nsvcd__v3 sum = nsvcd__v3_set(t->position);
  sum = nsvcd__v3_fma(a.z, nsvcd__v3_set(columns.z), sum);
  sum = nsvcd__v3_fma(a.y, nsvcd__v3_set(columns.y), sum);
  return nsvcd__v3_fma(a.x, nsvcd__v3_set(columns.x), sum);
}

// Of quaternions that need not be of unit length, but whose squares float holds.
static inline nsvcd__vmat3 nsvcd__vmat3_of(nsvcd__vquat q) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v3 axis = nsvcd__vquat_axis(q);
  const nsvcd__v square = nsvcd__v_add(nsvcd__v_mul(q.w, q.w), nsvcd__v3_dot(axis, axis));
  const nsvcd__v3 s = nsvcd__v3_scale(axis, nsvcd__v_div(nsvcd__v_set(2), square));
  // products of twice x and of w with each, and those that are left
  const nsvcd__v3 x = nsvcd__v3_scale(axis, s.x);
  const nsvcd__v3 w = nsvcd__v3_scale(s, q.w);
  const nsvcd__v yy = nsvcd__v_mul(s.y, q.y);
  const nsvcd__v zz = nsvcd__v_mul(s.z, q.z);
  const nsvcd__v yz = nsvcd__v_mul(s.y, q.z);
  return nsvcd__vmat3_rows(
      nsvcd__v3_of(nsvcd__v_sub(one, nsvcd__v_add(yy, zz)), nsvcd__v_sub(x.y, w.z),
                   nsvcd__v_add(x.z, w.y)),
      nsvcd__v3_of(nsvcd__v_add(x.y, w.z), nsvcd__v_sub(one, nsvcd__v_add(x.x, zz)),
                   nsvcd__v_sub(yz, w.x)),
      nsvcd__v3_of(nsvcd__v_sub(x.z, w.y), nsvcd__v_add(yz, w.x),
                   nsvcd__v_sub(one, nsvcd__v_add(x.x, yy))));
}

// ======================================================================== motion: where bodies are

// ----------------------------------------------------------------------------------- motion/motion
// In: two movers: bodies, their scales, and their poses, t in [0,1]; between poses the position is
// linear and the rotation a slerp on the shorter arc. Out: the pose of one of them, *moving*, in
// the frame of the other, *fixed*, at any t. Both may move; "fixed" says whose frame it is, in
// units of its scale, so that its stored numbers need no change. A point x of the moving body is at
// scale R x + p there. Positions are subtracted in the world first, so a scene far from the origin
// loses nothing. Two poses exactly 180 degrees apart have two shortest arcs: rounding picks one.
//
// Time is counted in *ticks*, of which a motion has a whole number, and so has each body between
// two of its poses: the least common multiple. Where poses have times of their own, 2^31 or more,
// and each of these is at the nearest. A *knot* is a tick at which a pose of either is. Between two
// knots both motions are smooth.

// The poses of one body.
typedef struct nsvcd__track {
  // (count), the caller's
  const nsvcd_pose *poses;
  // (count), the caller's, where there are two poses or more; NULL: uniform
  const float *times;
  size_t count;
  // from a pose to the next; all of them where there is one pose; 0 where there are times
  uint32_t ticks;
  // of the motion, where there are times
  uint32_t whole;
} nsvcd__track;

// The tick at which a track's pose k is.
static uint32_t nsvcd__tick_of(const nsvcd__track *track, uint32_t k) {
  if (!track->times) return k * track->ticks;
  return (uint32_t)((double)track->times[k] * (double)track->whole + 0.5);
}

// The last pose of a track that is not after a tick, or, at the end of several, the last but one.
static uint32_t nsvcd__pose_before(const nsvcd__track *track, uint32_t tick) {
  if (track->count == 1) return 0;
  const uint32_t last = (uint32_t)(track->count - 2);
  if (!track->times) {
    const uint32_t k = track->ticks == 1 ? tick : tick / track->ticks;
    return k < last ? k : last;
  }
  uint32_t low = 0;
  uint32_t high = last;
  while (low < high) {
    const uint32_t middle = (low + high + 1) / 2;
    if (nsvcd__tick_of(track, middle) <= tick)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

typedef struct nsvcd__motion {
  nsvcd__track moving, fixed;
  uint32_t ticks;  // in all
  // t: 0 and 1; of one end alone 0 or 1, and 0
  double begin, duration;
  // else it has one pose
  int fixed_moves;
  float scale;      // of the moving body, over that of the fixed one,
  float per_scale;  // and the other way round
  // of the fixed body's frame: its scale, metres
  float unit;
  nsvcd__f3 fixed_position;  // of the fixed body at t = 0, metres
  // world axes to the fixed body's axes at t = 0
  nsvcd__mat3 to_fixed;
  nsvcd__quat to_fixed_quat;
  // of the moving body's origin less the fixed one's, in world axes, metres
  nsvcd__f3 low, high;
  // by which the moving body is held off its poses, as the fixed one sees it, in its units
  nsvcd__f3 lift;
} nsvcd__motion;

// Are all numbers in range and all quaternions of unit length, to 1e-4?
static int nsvcd__poses_are_valid(const nsvcd_pose *poses, size_t count) {
  // 7 to a pose
  const float *numbers = poses->position;
  uint32_t most = 0;
  float shortest = 1;
  float longest = 1;
  for (size_t k = 0; k < 7 * count; k++) {
    const uint32_t bits = nsvcd__magnitude(numbers[k]);
    most = bits > most ? bits : most;
  }
  if (most > nsvcd__magnitude(NSVCD_MAX_COORDINATE)) return 0;
  for (size_t k = 0; k < count; k++) {
    const float *q = poses[k].rotation;
    const float square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
    shortest = square < shortest ? square : shortest;
    longest = square > longest ? square : longest;
  }
  return shortest >= 0.9998f && longest <= 1.0002f;
}

// Do they rise from 0 to 1, or are there none?
static int nsvcd__times_are_valid(const float *times, size_t count) {
  if (!times || count == 1) return 1;
  int rise =
      !(times[0] < 0) && !(times[0] > 0) && times[count - 1] <= 1 && times[count - 1] >= 1;
  // what is not a number does not rise
  for (size_t k = 1; k < count; k++)
    rise &= (double)times[k] - (double)times[k - 1] >= 0.99e-7;
  return rise;
}

// What a mover that is at rest at the origin is given.
static const nsvcd_pose nsvcd__at_origin = {{0, 0, 0}, {0, 0, 0, 1}};

// A mover's scale, which is 1 where 0 is given.
static float nsvcd__scale_of(const nsvcd_mover *mover) {
  return mover->scale > 0 ? mover->scale : 1;
}

static size_t nsvcd__pose_count(const nsvcd_mover *mover) {
  return mover->poses ? mover->count : 1;
}

static nsvcd_result nsvcd__poses_check(const nsvcd_mover *mover) {
  if (!mover->poses) return mover->count == 0 ? NSVCD_OK : NSVCD_ERROR_ARGUMENT;
  if (mover->count < 1 || mover->count > NSVCD_MAX_POSES) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__times_are_valid(mover->times, mover->count)) return NSVCD_ERROR_POSE;
  return nsvcd__poses_are_valid(mover->poses, mover->count) ? NSVCD_OK : NSVCD_ERROR_POSE;
}

static nsvcd_result nsvcd__mover_check(const nsvcd_mover *mover) {
  if (!mover->body) return NSVCD_ERROR_ARGUMENT;
  const float scale = mover->scale;
  if (!nsvcd__is_finite(scale) || scale < 0) return NSVCD_ERROR_SCALE;
  if (scale > 0) {
    if (scale < NSVCD_MIN_SCALE || scale > NSVCD_MAX_SCALE) return NSVCD_ERROR_SCALE;
    const float radius = nsvcd__whole_radius(mover->body);
    if (scale * radius < NSVCD_MIN_RADIUS) return NSVCD_ERROR_SCALE;
    if (scale * mover->body->extent > 2 * NSVCD_MAX_COORDINATE) return NSVCD_ERROR_SCALE;
  }
  return nsvcd__poses_check(mover);
}

static nsvcd__track nsvcd__track_of(const nsvcd_mover *mover) {
  const size_t count = nsvcd__pose_count(mover);
  const nsvcd__track track = {mover->poses ? mover->poses : &nsvcd__at_origin,
                              count > 1 ? mover->times : NULL, count, 0, 0};
  return track;
}

// The motion's ticks as if all poses were uniform, `parts` times as many as its knots need. No more
// than 65,535 * 65,534, which 32 bits hold, for parts is 1 but where knots are few.
static void nsvcd__motion_set_ticks(nsvcd__motion *motion, uint32_t parts) {
  const uint32_t a = motion->moving.count > 1 ? (uint32_t)(motion->moving.count - 1) : 1;
  const uint32_t b = motion->fixed.count > 1 ? (uint32_t)(motion->fixed.count - 1) : 1;
  uint32_t divisor = a;
  for (uint32_t rest = b; rest;) {
    const uint32_t next = divisor % rest;
    divisor = rest;
    rest = next;
  }
  motion->ticks = a / divisor * b * parts;
  motion->moving.ticks = motion->ticks / a;
  motion->fixed.ticks = motion->ticks / b;
}

// The ticks of a motion of which poses have times: the poses of a uniform body times a power of
// two, so that these, and times of few bits, are at ticks.
static void nsvcd__motion_set_times(nsvcd__motion *motion) {
  nsvcd__track *tracks[2] = {&motion->moving, &motion->fixed};
  uint32_t arcs = 1;
  if (!motion->moving.times && !motion->fixed.times) return;
  for (size_t n = 0; n < 2; n++) {
    if (!tracks[n]->times && tracks[n]->count > 1) arcs = (uint32_t)(tracks[n]->count - 1);
  }
  motion->ticks = arcs;
  while (motion->ticks < 0x80000000u) motion->ticks *= 2;
  for (size_t n = 0; n < 2; n++) {
    tracks[n]->whole = motion->ticks;
    tracks[n]->ticks = tracks[n]->times       ? 0
                       : tracks[n]->count > 1 ? motion->ticks / arcs
                                              : motion->ticks;
  }
}

// Where poses have times, segments begin where they would if these were uniform: what counts is how
// far bodies go in one. The uniform ticks in begin (S + 1) become the motion's.
static void nsvcd__motion_retime(nsvcd__motion *motion, uint32_t *begin, size_t segments) {
  const nsvcd__track *track = motion->moving.times ? &motion->moving : &motion->fixed;
  if (!track->times) return;
  const uint32_t each = track->ticks;
  nsvcd__motion_set_times(motion);
  for (size_t s = 0; s < segments; s++) {
    const uint32_t k = begin[s] / each;
    const uint32_t from = nsvcd__tick_of(track, k);
    const uint64_t length = nsvcd__tick_of(track, k + 1) - from;
    begin[s] = from + (uint32_t)(length * (begin[s] - k * each) / each);
  }
  begin[segments] = motion->ticks;
}

// The box of a track's positions.
static nsvcd__box nsvcd__track_box(const nsvcd__track *track) {
  nsvcd__box box;
  box.low = box.high = nsvcd__f3_load(track->poses->position);
  for (size_t n = 1; n < track->count; n++) {
    const nsvcd__f3 position = nsvcd__f3_load(track->poses[n].position);
    box.low = nsvcd__f3_min(box.low, position);
    box.high = nsvcd__f3_max(box.high, position);
  }
  return box;
}

// Prepares what follows from a motion's tracks.
static void nsvcd__motion_set_tracks(nsvcd__motion *motion, nsvcd__track moving,
                                     nsvcd__track fixed) {
  motion->moving = moving;
  motion->fixed = fixed;
  motion->fixed_moves = motion->fixed.count > 1;
  nsvcd__motion_set_ticks(motion, 1);
  nsvcd__motion_set_times(motion);

  const nsvcd_pose *first = motion->fixed.poses;
  const nsvcd__quat q = nsvcd__quat_unit(nsvcd__quat_load(first->rotation));
  motion->to_fixed = nsvcd__mat3_transpose(nsvcd__mat3_of(q));
  motion->to_fixed_quat = nsvcd__quat_inverse(q);
  motion->fixed_position = nsvcd__f3_load(first->position);

  const nsvcd__box at = nsvcd__track_box(&motion->moving);
  const nsvcd__box from = nsvcd__track_box(&motion->fixed);
  motion->low = nsvcd__f3_sub(at.low, from.high);
  motion->high = nsvcd__f3_sub(at.high, from.low);
}

// Prepares the motion of valid movers. Keeps the pointers to their poses.
static void nsvcd__motion_init(const nsvcd_mover *moving, const nsvcd_mover *fixed,
                               nsvcd__motion *motion) {
  motion->unit = nsvcd__scale_of(fixed);
  motion->scale = nsvcd__scale_of(moving) / motion->unit;
  motion->per_scale = 1 / motion->scale;
  motion->lift = nsvcd__f3_of(0, 0, 0);
  motion->begin = 0;
  motion->duration = 1;
  nsvcd__motion_set_tracks(motion, nsvcd__track_of(moving), nsvcd__track_of(fixed));
}

// In the fixed body's units: the moving body's origin always stays so far from the fixed one's.
static float nsvcd__motion_gap(const nsvcd__motion *motion) {
  const nsvcd__f3 above = nsvcd__f3_scale(motion->high, -1);
  const nsvcd__f3 gap = nsvcd__f3_max(motion->low, above);
  const nsvcd__f3 apart = nsvcd__f3_max(gap, nsvcd__f3_of(0, 0, 0));
  return 0.99999f * nsvcd__f3_length(apart) / motion->unit;
}

// Is the shorter arc from a to b the one to -b?
static inline int nsvcd__poses_opposed(const nsvcd_pose *a, const nsvcd_pose *b) {
  return nsvcd__quats_opposed(nsvcd__quat_load(a->rotation), nsvcd__quat_load(b->rotation));
}

// A body's pose in the world: rotation unit to 1e-4, position in metres. In double: on a long way
// past the other body, roundings of its ends would be large beside what is near.
typedef struct nsvcd__world_pose {
  nsvcd__quat rotation;
  nsvcd__d3 position;
} nsvcd__world_pose;

static nsvcd__world_pose nsvcd__world_pose_of(const nsvcd_pose *pose) {
  const nsvcd__world_pose out = {nsvcd__quat_load(pose->rotation),
                                 nsvcd__d3_load(pose->position)};
  return out;
}

// Between two poses, a share of the way from the first.
static nsvcd__world_pose nsvcd__world_pose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                   double share) {
  const nsvcd__world_pose from = nsvcd__world_pose_of(a);
  const nsvcd__world_pose to = nsvcd__world_pose_of(b);
  nsvcd__world_pose out;
  out.rotation = nsvcd__quat_slerp(from.rotation, to.rotation, (float)share);
  out.position = nsvcd__d3_mix(from.position, to.position, share);
  return out;
}

// A track's pose at a tick.
static nsvcd__world_pose nsvcd__track_pose(const nsvcd__track *track, uint32_t tick) {
  const uint32_t k = nsvcd__pose_before(track, tick);
  const nsvcd_pose *a = &track->poses[k];
  const uint32_t from = nsvcd__tick_of(track, k);
  if (tick == from || track->count == 1) return nsvcd__world_pose_of(a);
  const uint32_t to = nsvcd__tick_of(track, k + 1);
  if (tick == to) return nsvcd__world_pose_of(a + 1);
  return nsvcd__world_pose_between(a, a + 1, (double)(tick - from) / (double)(to - from));
}

// The tick of a track's next pose after a tick that is not the last.
static uint32_t nsvcd__next_pose(const nsvcd__track *track, uint32_t tick) {
  return nsvcd__tick_of(track, nsvcd__pose_before(track, tick) + 1);
}

// The knot after a tick.
static uint32_t nsvcd__next_knot(const nsvcd__motion *motion, uint32_t tick) {
  if (motion->moving.ticks == 1 || motion->fixed.ticks == 1) return tick + 1;
  const uint32_t after_a = nsvcd__next_pose(&motion->moving, tick);
  const uint32_t after_b = nsvcd__next_pose(&motion->fixed, tick);
  return after_a < after_b ? after_a : after_b;
}

// Poses of both bodies at the times of one slice, in the world.
typedef struct nsvcd__v_poses {
  // of any length
  nsvcd__vquat moving;
  nsvcd__vquat fixed;  // unit; only where that body moves
  // of the moving body's origin from the fixed one's, metres
  nsvcd__v3 offset;
} nsvcd__v_poses;

// A slice of poses.
typedef struct nsvcd__v_pose {
  nsvcd__vquat rotation;
  nsvcd__v3 position;
} nsvcd__v_pose;

// The moving body's poses as the fixed one sees them: quaternions of any length, positions in its
// units.
static nsvcd__v_pose nsvcd__v_seen(const nsvcd__motion *motion, const nsvcd__v_poses *at) {
  const nsvcd__v per_metre = nsvcd__v_set(1 / motion->unit);
  nsvcd__vquat to_fixed;
  nsvcd__vmat3 matrix;
  if (motion->fixed_moves) {
    to_fixed = nsvcd__vquat_inverse(at->fixed);
    matrix = nsvcd__vmat3_of(to_fixed);
  } else {
    to_fixed = nsvcd__vquat_set(motion->to_fixed_quat);
    matrix = nsvcd__vmat3_set(&motion->to_fixed);
  }
  const nsvcd__v3 metres = nsvcd__vmat3_apply(matrix, at->offset);
  nsvcd__v_pose out;
  out.rotation = nsvcd__vquat_mul(to_fixed, at->moving);
  out.position = nsvcd__v3_fma(per_metre, metres, nsvcd__v3_set(motion->lift));
  return out;
}

#ifndef NSVCD_NO_NETWORK
// The pose of a track that moves before time t in [0,1], and the share of the way to the next. A
// uniform one is not taken to ticks: derivatives by t need what floats resolve.
static size_t nsvcd__pose_at(const nsvcd__track *track, float t, float *share) {
  if (track->times) {
    const double tick = (double)t * (double)track->whole;
    const uint32_t k = nsvcd__pose_before(track, (uint32_t)tick);
    const float from = track->times[k];
    *share = (t - from) / (track->times[k + 1] - from);
    return k;
  }
  const size_t last = track->count - 2;
  const float at = t * (float)(last + 1);
  const size_t k = (size_t)at < last ? (size_t)at : last;
  *share = at - (float)k;
  return k;
}

// A track's pose at time t in [0,1].
static nsvcd__world_pose nsvcd__track_pose_at(const nsvcd__track *track, float t) {
  if (track->count == 1) return nsvcd__world_pose_between(track->poses, track->poses, 0);
  float share;
  const size_t k = nsvcd__pose_at(track, t, &share);
  return nsvcd__world_pose_between(&track->poses[k], &track->poses[k + 1], (double)share);
}

// The moving body in the fixed body's frame at time t, clamped to [0,1]; its points are to be
// multiplied by the scale first.
static nsvcd__transform nsvcd__motion_pose(const nsvcd__motion *motion, float t) {
  const float when = t < 0 ? 0 : t > 1 ? 1 : t;
  const nsvcd__world_pose moving = nsvcd__track_pose_at(&motion->moving, when);
  const nsvcd__world_pose fixed = nsvcd__track_pose_at(&motion->fixed, when);
  const nsvcd__mat3 rotation = nsvcd__mat3_of(moving.rotation);
  const nsvcd__mat3 to_fixed = nsvcd__mat3_transpose(nsvcd__mat3_of(fixed.rotation));
  const nsvcd__d3 metres = nsvcd__d3_sub(moving.position, fixed.position);
  const nsvcd__f3 offset = nsvcd__d3_narrow(nsvcd__d3_over(metres, (double)motion->unit));
  nsvcd__transform out;
  out.rotation = nsvcd__mat3_mul(&to_fixed, &rotation);
  out.position = nsvcd__f3_add(nsvcd__mat3_apply(&to_fixed, offset), motion->lift);
  return out;
}
#endif

// --------------------------------------------------------------------------------- motion/segments
// In: a motion. Out: segments of time, and chords of spheres in them, grown so that the sphere is
// covered all the way: the broad phase is built on that. Conservative: spheres that meet at a time
// have chords that meet there, and if no chords do, the surfaces never meet, and that is a proof.
//
// Time is cut into S segments. Within one, every sphere centre c of the moving body (its frame) is
// taken along the chord between its places at the two ends, x0 + tau v, tau in [0,1], and the
// radius grows by
//   dev(c) = spread + bulge |c|
// so that it covers the true place (M(t) c + p(t)) at every t, M being the rotation times the
// scale. Why: let L(t) be the linear interpolation of M between the segment's ends, K(t) the
// piecewise linear one through the knots inside. Between two knots a chord misses a curve by at
// most max|second derivative| / 8, with time from 0 to 1 there. Where only one body moves, that is
// h^2 |c| / 8 on an arc of angle h, and its origin goes straight. Where both do, what the fixed
// body sees bends more: nsvcd__cut_double_arc. K - L is piecewise linear, its norm convex, so it is
// largest at a knot. Hence
//   bulge  = max over arcs of what they bend by per metre  +  max over knots ||M_k - L(t_k)||
//          (Frobenius >= 2-norm)
//   drift  = max over arcs of what the origin bends by  +  max over knots |p_k - its linear
//                                                       interpolation|
//   spread = drift + rounding + the clearance that is asked for
// Along a direction n, |n| <= 1, it is less. A turn by h about the unit axis a bends the way of a
// point x by a x (a x y) h^2, y being x, turned; and n.(a x (a x y)) = (n x a).(a x y), which is no
// more than |n x a| |x|: nothing along the axis. So `bulge_along_axis` and `drift_along_axis` are
// what is left along the axis of the whole segment's turn, off which the arcs' axes may be, and
// nsvcd__deviation puts them together.
//
// A group or a whole body is a sphere like any other: its sphere, truly posed, contains its
// members', truly posed.
//
// Hierarchy: body x body; groups near the body, in boxes, x groups; group x group; group x 16
// spheres; 16 spheres x sphere. But for the boxes every step is the same test, moving spheres on
// chords against resting spheres; the lanes are segments, or members of a group. A step of the
// search is a pair of groups. Moving groups that meet most come first, and of each the group that
// it meets longest, because a deep collision is then found before the rest is searched.
//
// A *tile* is up to 32 groups of one body and up to 32 of the other, which are searched together.
// Bodies of up to 512 patches make one tile. Of larger ones, a walk through the levels of spheres
// above the groups finds those that the other body comes near, and they are searched tile after
// tile: each moving tile against all tiles of the fixed body.

// of a motion, as long as none then turns by more than NSVCD__SEGMENT_TURN
#define NSVCD__SEGMENTS 16
// reached at 1280 degrees; beyond, segments turn more: still proven, only looser
#define NSVCD__MAX_SEGMENTS 64
#define NSVCD__SEGMENT_TURN 0.349f  // radians, 20 degrees
#define NSVCD__FINE_TURN 0.131f  // radians, 7.5 degrees: nothing is gained by shorter segments
// radians, 45 degrees: an interval is cut before it turns more, for the decoder's twist
#define NSVCD__INTERVAL_TURN 0.785f
#define NSVCD__BLOCKS (NSVCD__MAX_SEGMENTS / NSVCD__LANES)
// Of the lengths that go into a difference of places: about 15 float operations of 6e-8 each,
// doubled.
#define NSVCD__ROUNDING 2e-6f

// A contact interval: the patches `moving` and `fixed` overlap from t_enter to t_exit (both with
// the deviation added).
typedef struct nsvcd__candidate {
  uint16_t moving, fixed;
  float t_enter, t_exit;
  float t_least;  // where the gap is least
  // rank, 1 - least distance / (r1 + r2): the deepest go on to the network
  float depth;
  // what the network says, or NSVCD__NO_SCORE
  float score;
} nsvcd__candidate;

#define NSVCD__NO_SCORE (-1e30f)

// Chords start + tau way of 16 moving spheres, their radii plus deviation, and -1 / |way|^2.
typedef struct nsvcd__chords {
  float start[3][NSVCD__LANES];
  float way[3][NSVCD__LANES];
  float inverse[NSVCD__LANES];
  float reach[NSVCD__LANES];
} nsvcd__chords;

// 16 segments: pose at the start, change of the pose until the end, deviation.
typedef struct nsvcd__segments {
  float rotation[9][NSVCD__LANES], position[3][NSVCD__LANES], turned[9][NSVCD__LANES],
      moved[3][NSVCD__LANES];
  float spread[NSVCD__LANES], bulge[NSVCD__LANES];
  // For the proof, the same along directions: see nsvcd__deviation.
  float rounding[NSVCD__LANES], drift[NSVCD__LANES], axis[3][NSVCD__LANES],
      bulge_along_axis[NSVCD__LANES];
  float drift_along_axis[NSVCD__LANES], way[3][NSVCD__LANES], drift_off_way[NSVCD__LANES];
} nsvcd__segments;

// Poses of both bodies at 16 ticks, and one more, in the world; and quaternions as the fixed body
// sees them.
#define NSVCD__KNOTS (NSVCD__LANES + 1)
typedef struct nsvcd__knots {
  // (4, KNOTS) quaternions, as the next two
  float moving[4 * NSVCD__KNOTS];
  float fixed[4 * NSVCD__KNOTS];
  float seen[4 * NSVCD__KNOTS];
  // (3, KNOTS) see nsvcd__v_poses
  float offset[3 * NSVCD__KNOTS];
} nsvcd__knots;

// What is kept of 16 segments while their knots are visited, lane by lane.
typedef struct nsvcd__bends {
  float sum[NSVCD__LANES];  // of the turns of arcs
  // The greatest so far of what arcs leave their chords by: per metre from the moving body's
  // origin, along the axis too, and that origin itself.
  float arc_bulge[NSVCD__LANES], axis_turn[NSVCD__LANES], arc_drift[NSVCD__LANES];
  // The greatest so far, squared, of what knots are off their chord by: the rotation and the
  // position, and both along the axis, or across the way.
  float bulge[NSVCD__LANES], spread[NSVCD__LANES], axis_bulge[NSVCD__LANES],
      axis_drift[NSVCD__LANES];
  float way_drift[NSVCD__LANES];
} nsvcd__bends;

typedef struct nsvcd__cut {
  // read now, the ones before, and those at the segments' ends
  nsvcd__knots here, last, end;
  nsvcd__bends most;
} nsvcd__cut;

// 16 boxes, as their least and greatest coordinates.
typedef struct nsvcd__boxes {
  float low[3][NSVCD__LANES], high[3][NSVCD__LANES];
} nsvcd__boxes;

// Groups that are searched together: their numbers and spheres. Lanes without a group have r =
// NSVCD__NOWHERE.
typedef struct nsvcd__tile {
  size_t count;
  uint16_t groups[NSVCD__TILE_SLOTS];
  // the body's own where it has no more than a tile, else gathered
  nsvcd__spheres spheres;
  // (4, NSVCD__TILE_SLOTS), or NULL
  float *gathered;
} nsvcd__tile;

// What a query needs memory for.
typedef struct nsvcd__needs {
  size_t moving_groups, fixed_groups;  // of a tile
  // a body has more than these
  int large;
  // 16, 32, 48 or 64
  size_t segments;
  // of the network
  size_t candidates;
  int proof;
} nsvcd__needs;

typedef struct nsvcd__search {
  const nsvcd_body *moving, *fixed;
  size_t segments;  // S
  // that there is room for
  size_t most_segments;
  float scale;  // of the moving body
  // (S + 1) ticks at which they begin, then the last one
  uint32_t *begin;
  float *time;  // (S + 1) of the ends of the segments
  // (S + 1) rotation arc from t = 0 to there, radians
  float *turn;
  nsvcd__segments *blocks;  // (S / 16 rounded up)
  // (S / 16 rounded up) a moving group's
  nsvcd__chords *group;
  nsvcd__chords *members;  // (S) its 16 members', per segment
  // in the same place: segments are cut before any search
  nsvcd__cut *cut;
  uint64_t near_segments;  // in which the bodies' spheres meet
  // through the groups that come near; where a body is large
  nsvcd__walk moving_walk, fixed_walk;
  nsvcd__box near_box;  // about the way of the moving tile
  // the groups that are searched now; below, places in these
  nsvcd__tile moving_tile, fixed_tile;
  // (moving groups, fixed groups) segments in which they meet
  uint64_t *nearby;
  size_t nearby_stride;  // see nsvcd__nearby
  // segments to search; all, but where contacts are sought in order
  uint64_t wanted;
  // moving groups that are near any, in the order of the search
  uint16_t order[NSVCD__TILE_SLOTS];
  // how many they are, and which of them is being searched
  size_t steps, step;
  // fixed groups that it has yet to be searched against
  uint32_t waiting;
  uint64_t posed;  // segments for which members[] is filled
  // no part of these members is farther from the body's origin
  float remote;
} nsvcd__search;

// Vectors that cross cache lines take longer: the arrays of 16 lanes begin with one, where there
// are vectors. Up to so many bytes are passed over for that; where base is NULL, all of them are
// counted.
#define NSVCD__PASSED_OVER (NSVCD__SLICE > 1 ? 64 - NSVCD_ALIGNMENT : 0)
static void nsvcd__take_to_line(char *base, uint64_t *used) {
  if (NSVCD__PASSED_OVER == 0) return;
  *used += base ? (0 - (uintptr_t)(base + *used)) & 63 : NSVCD__PASSED_OVER;
}

// Lays a workspace out in base, or, where that is NULL, only counts.
static void nsvcd__search_layout(const nsvcd__needs *needs, char *base, uint64_t *used,
                                 nsvcd__search *search) {
  const size_t s = needs->segments;
  const size_t blocks = s / NSVCD__LANES;
  const size_t members = s * sizeof(nsvcd__chords);
  const size_t gathered = needs->large ? 4 * NSVCD__TILE_SLOTS : 0;
  search->most_segments = s;
  search->begin = (uint32_t *)nsvcd__take(base, used, s + 1, sizeof(uint32_t));
  search->time = (float *)nsvcd__take(base, used, s + 1, sizeof(float));
  search->turn = (float *)nsvcd__take(base, used, s + 1, sizeof(float));
  nsvcd__take_to_line(base, used);
  search->blocks = (nsvcd__segments *)nsvcd__take(base, used, blocks, sizeof(nsvcd__segments));
  search->group = (nsvcd__chords *)nsvcd__take(base, used, blocks, sizeof(nsvcd__chords));
  search->members = (nsvcd__chords *)nsvcd__take(
      base, used, 1, members > sizeof(nsvcd__cut) ? members : sizeof(nsvcd__cut));
  search->cut = (nsvcd__cut *)(void *)search->members;
  search->nearby_stride = needs->fixed_groups;
  search->nearby = (uint64_t *)nsvcd__take(
      base, used, needs->moving_groups * needs->fixed_groups, sizeof(uint64_t));
  search->moving_tile.gathered = (float *)nsvcd__take(base, used, gathered, sizeof(float));
  search->fixed_tile.gathered = (float *)nsvcd__take(base, used, gathered, sizeof(float));
}

// Memory for chords, and for boxes, that need not come from the stack: where the members of a group
// will be posed later.
static nsvcd__chords *nsvcd__spare_chords(const nsvcd__search *search) {
  return &search->members[0];
}
static nsvcd__boxes *nsvcd__spare_boxes(const nsvcd__search *search) {
  return (nsvcd__boxes *)(void *)&search->members[1];
}

// The segments in which group g of the moving tile meets each one of the fixed tile.
static uint64_t *nsvcd__nearby(const nsvcd__search *search, size_t g) {
  return search->nearby + g * search->nearby_stride;
}

// Not less than the angle between two rotations, unit to 1e-4, and hardly more where it is small: 4
// asin(chord / 2) of their chord as quaternions, asin x <= x + (pi/2 - 1) x^3, and half a
// thousandth for the lengths. chord2: its square.
static nsvcd__v nsvcd__v_arc_bound(nsvcd__v chord2) {
  const nsvcd__v x = nsvcd__v_scale(nsvcd__v_sqrt(chord2), 0.50025f);
  const nsvcd__v square = nsvcd__v_mul(x, x);
  return nsvcd__v_mul(x, nsvcd__v_fma(nsvcd__v_set(2.2832f), square, nsvcd__v_set(4)));
}

// The vector part of b a^-1, of two quaternions: the axis of the turn from a to b, times the sine
// of half its angle.
static nsvcd__v3 nsvcd__v_turn_between(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v3 u = nsvcd__vquat_axis(a);
  const nsvcd__v3 v = nsvcd__vquat_axis(b);
  const nsvcd__v3 sum = nsvcd__v3_fma(nsvcd__v_negate(b.w), u, nsvcd__v3_cross(u, v));
  return nsvcd__v3_fma(a.w, v, sum);
}

// 1 where x >= 0, else -1.
static nsvcd__v nsvcd__v_sign(nsvcd__v x) {
  return nsvcd__v_pick(nsvcd__v_set(0), x, nsvcd__v_set(1), nsvcd__v_set(-1));
}

// The same on the shorter arc. cosine: of half the angle; near 0, rounding may have taken the
// longer one.
static nsvcd__v3 nsvcd__v_shorter_turn_between(nsvcd__vquat a, nsvcd__vquat b,
                                               nsvcd__v *cosine) {
  const nsvcd__v dot = nsvcd__vquat_dot(a, b);
  const nsvcd__v sign = nsvcd__v_sign(dot);
  *cosine = nsvcd__v_mul(sign, dot);
  return nsvcd__v3_scale(nsvcd__v_turn_between(a, b), sign);
}

// Bounds of the total length of a track's rotation arcs, radians, and of the longest.
static void nsvcd__measure_turn(const nsvcd__track *track, float *turn, float *widest) {
  float chord2[NSVCD__LANES];
  float sums[NSVCD__LANES] = {0};
  float longest[NSVCD__LANES] = {0};
  for (size_t first = 0; first + 1 < track->count; first += NSVCD__LANES) {
    const size_t left = track->count - 1 - first;
    const size_t count = left < NSVCD__LANES ? left : NSVCD__LANES;
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      const float *a = track->poses[first + (l < count ? l : count - 1)].rotation;
      const float *b = track->poses[first + (l < count ? l + 1 : count - 1)].rotation;
      const float dot = (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
      const float sign = dot < 0 ? -1.0f : 1.0f;
      float d[4];
      for (size_t k = 0; k < 4; k++) d[k] = sign * b[k] - a[k];
      chord2[l] = (d[0] * d[0] + d[1] * d[1]) + (d[2] * d[2] + d[3] * d[3]);
    }
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v arc = nsvcd__v_arc_bound(nsvcd__v_load(chord2 + l));
      nsvcd__v_store(sums + l, nsvcd__v_add(nsvcd__v_load(sums + l), arc));
      nsvcd__v_store(longest + l, nsvcd__v_max(nsvcd__v_load(longest + l), arc));
    }
  }
  *turn = 0;
  *widest = 0;
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    *turn += sums[l];
    *widest = longest[l] > *widest ? longest[l] : *widest;
  }
}

// How many segments, and into how many parts a tick must be cut where there are too few for that
// (else 1). Segments begin at ticks.
static size_t nsvcd__segment_count(const nsvcd__motion *motion, size_t greatest,
                                   uint32_t *parts) {
  const size_t ticks = motion->ticks;
  float turn;
  float widest;
  float fixed_turn = 0;
  float fixed_widest = 0;
  *parts = 1;
  if (motion->moving.count == 1 && !motion->fixed_moves) return 1;
  nsvcd__measure_turn(&motion->moving, &turn, &widest);
  if (motion->fixed_moves) nsvcd__measure_turn(&motion->fixed, &fixed_turn, &fixed_widest);
  turn = turn + fixed_turn < 1e3f ? turn + fixed_turn : 1e3f;
  const size_t coarse = (size_t)ceilf(turn / NSVCD__SEGMENT_TURN);
  const size_t fine = (size_t)ceilf(turn / NSVCD__FINE_TURN);
  size_t wanted = fine < NSVCD__SEGMENTS ? fine : NSVCD__SEGMENTS;
  if (wanted < coarse) wanted = coarse < greatest ? coarse : greatest;
  if (wanted < 1) wanted = 1;
  if (ticks > wanted)
    return ticks < NSVCD__SEGMENTS    ? ticks
           : wanted < NSVCD__SEGMENTS ? NSVCD__SEGMENTS
                                      : wanted;
  const float of_tick =
      widest / (float)motion->moving.ticks + fixed_widest / (float)motion->fixed.ticks;
  const size_t least = (size_t)ceilf(of_tick / NSVCD__SEGMENT_TURN);
  const size_t most = greatest / ticks;
  size_t each = wanted / ticks > least ? wanted / ticks : least;
  each = each < most ? each : most;
  *parts = (uint32_t)(each > 1 ? each : 1);
  return ticks * *parts;
}

// Reads the poses of both bodies at the first `count` of these ticks; where one body moves and
// every tick is one of its poses, as the caller gave them.
static void nsvcd__knots_read(const nsvcd__motion *motion, const uint32_t *ticks, size_t count,
                              nsvcd__knots *out) {
  const nsvcd__track *track = &motion->moving;
  const int as_given = track->ticks == 1 && track->count > 1 && !motion->fixed_moves;
  nsvcd__world_pose fixed = {{0, 0, 0, 1}, nsvcd__d3_widen(motion->fixed_position)};
  for (size_t l = 0; l < count; l++) {
    nsvcd__quat rotation;
    nsvcd__f3 offset;
    if (as_given) {
      const nsvcd_pose *pose = &track->poses[ticks[l]];
      rotation = nsvcd__quat_load(pose->rotation);
      offset = nsvcd__f3_sub(nsvcd__f3_load(pose->position), motion->fixed_position);
    } else {
      const nsvcd__world_pose moving = nsvcd__track_pose(track, ticks[l]);
      if (motion->fixed_moves) fixed = nsvcd__track_pose(&motion->fixed, ticks[l]);
      rotation = moving.rotation;
      offset = nsvcd__d3_narrow(nsvcd__d3_sub(moving.position, fixed.position));
      if (motion->fixed_moves) nsvcd__quat_put(fixed.rotation, out->fixed + l, NSVCD__KNOTS);
    }
    nsvcd__f3_put(offset, out->offset + l, NSVCD__KNOTS);
    nsvcd__quat_put(rotation, out->moving + l, NSVCD__KNOTS);
  }
}

// A slice of them, from the one in lane `first` on, up to LANES - SLICE + 1: there is one knot more
// than lanes.
static nsvcd__v_poses nsvcd__knots_load(const nsvcd__motion *motion, const nsvcd__knots *from,
                                        size_t first) {
  nsvcd__v_poses out;
  out.offset = nsvcd__v3_load_rows(from->offset + first, NSVCD__KNOTS);
  out.moving = nsvcd__vquat_load(from->moving + first, NSVCD__KNOTS);
  out.fixed = out.moving;
  if (motion->fixed_moves) {
    out.moving = nsvcd__vquat_unit(out.moving);
    out.fixed = nsvcd__vquat_unit(nsvcd__vquat_load(from->fixed + first, NSVCD__KNOTS));
  }
  return out;
}

// `seen`: the quaternions as the fixed body sees them. l: the slice's first lane, here and below.
static void nsvcd__knots_keep(const nsvcd__motion *motion, const nsvcd__v_poses *at,
                              nsvcd__vquat seen, size_t l, nsvcd__knots *out) {
  nsvcd__vquat_store(at->moving, out->moving + l, NSVCD__KNOTS);
  nsvcd__vquat_store(seen, out->seen + l, NSVCD__KNOTS);
  if (!motion->fixed_moves) return;
  nsvcd__v3_store_rows(at->offset, out->offset + l, NSVCD__KNOTS);
  nsvcd__vquat_store(at->fixed, out->fixed + l, NSVCD__KNOTS);
}

// A bound of the angle between two unit quaternions, lane by lane.
static nsvcd__v nsvcd__v_arc(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__vquat_dot(a, b));
  const nsvcd__v x = nsvcd__v_sub(nsvcd__v_mul(sign, b.x), a.x);
  const nsvcd__v y = nsvcd__v_sub(nsvcd__v_mul(sign, b.y), a.y);
  const nsvcd__v z = nsvcd__v_sub(nsvcd__v_mul(sign, b.z), a.z);
  const nsvcd__v w = nsvcd__v_sub(nsvcd__v_mul(sign, b.w), a.w);
  const nsvcd__vquat chord = {x, y, z, w};
  return nsvcd__v_arc_bound(nsvcd__vquat_dot(chord, chord));
}

// A bound of h^2 / 8 |axis x a|, of a turn by h (arc: a bound of it) about a: with w = a sin(h / 2)
// that is no more than pi / 8 h |axis x w|.
static nsvcd__v nsvcd__v_turn_off_axis(nsvcd__v3 axis, nsvcd__vquat from, nsvcd__vquat to,
                                       nsvcd__v arc) {
  const nsvcd__v3 across = nsvcd__v3_cross(axis, nsvcd__v_turn_between(from, to));
  return nsvcd__v_mul(nsvcd__v_scale(arc, 0.3931f), nsvcd__v3_length(across));
}

// most, sum: of the slice.
static void nsvcd__v_keep_most(float *most, nsvcd__v value) {
  nsvcd__v_store(most, nsvcd__v_max(nsvcd__v_load(most), value));
}
static void nsvcd__v_add_to(float *sum, nsvcd__v value) {
  nsvcd__v_store(sum, nsvcd__v_add(nsvcd__v_load(sum), value));
}

// Poses at the starts of 16 segments, whose ticks are begin[0..16]. Starts the visit of the knots
// within.
static NSVCD__APART void nsvcd__cut_starts(const nsvcd__motion *motion, const uint32_t *begin,
                                           nsvcd__segments *out, nsvcd__cut *cut) {
  const nsvcd__v scale = nsvcd__v_set(motion->scale);
  memset(&cut->most, 0, sizeof cut->most);
  nsvcd__knots_read(motion, begin, NSVCD__KNOTS, &cut->here);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__knots_load(motion, &cut->here, l);
    const nsvcd__v_pose seen = nsvcd__v_seen(motion, &at);
    const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
    nsvcd__knots_keep(motion, &at, seen.rotation, l, &cut->last);
    nsvcd__vmat3_store(out->rotation, l, nsvcd__vmat3_scale(rotation, scale));
    nsvcd__v3_store(out->position, l, seen.position);
  }
}

// The same at their ends; the starts are known.
static NSVCD__APART void nsvcd__cut_ends(const nsvcd__motion *motion, nsvcd__segments *out,
                                         nsvcd__cut *cut) {
  const nsvcd__v scale = nsvcd__v_set(motion->scale);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__knots_load(motion, &cut->here, l + 1);
    const nsvcd__v_pose seen = nsvcd__v_seen(motion, &at);
    const nsvcd__vmat3 end = nsvcd__vmat3_scale(nsvcd__vmat3_of(seen.rotation), scale);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__v3 moved = nsvcd__v3_sub(seen.position, nsvcd__v3_load(out->position, l));
    const nsvcd__vquat seen_first = nsvcd__vquat_load(cut->last.seen + l, NSVCD__KNOTS);
    const nsvcd__v3 turn = nsvcd__v_turn_between(seen_first, seen.rotation);
    nsvcd__knots_keep(motion, &at, seen.rotation, l, &cut->end);
    nsvcd__vmat3_store(out->turned, l, nsvcd__vmat3_sub(end, start));
    nsvcd__v3_store(out->moved, l, moved);
    nsvcd__v3_store(out->axis, l, nsvcd__v3_unit(turn));
    nsvcd__v3_store(out->way, l, nsvcd__v3_unit(moved));
  }
}

// Of arcs in which both bodies move. With w and w' the rotation vectors of the moving and the fixed
// body over the arc, in the world, o = w - w', and d the way from the fixed origin to the moving
// one, which goes by v, the second derivative of what the fixed body sees of a point x is, in its
// axes,
//   o x (o x Rx) + (o x w') x Rx   -   2 w' x v + w' x (w' x d)
// so that the arc leaves its chord by (|o|^2 + |o x w'|) / 8 |x| and (2 |w' x v| + |w'| |w' x d|) /
// 8 at most.
static void nsvcd__cut_double_arc(const nsvcd__motion *motion, const nsvcd__v_poses *from,
                                  const nsvcd__v_poses *to, size_t l, nsvcd__cut *cut) {
  const nsvcd__v eighth = nsvcd__v_set(0.12501f);
  nsvcd__v cosine;
  nsvcd__v fixed_cosine;
  const nsvcd__v3 half = nsvcd__v_shorter_turn_between(from->moving, to->moving, &cosine);
  const nsvcd__v3 fixed_half =
      nsvcd__v_shorter_turn_between(from->fixed, to->fixed, &fixed_cosine);
  const nsvcd__v sine = nsvcd__v3_length(half);
  const nsvcd__v fixed_sine = nsvcd__v3_length(fixed_half);
  const nsvcd__v sines = nsvcd__v_add(sine, fixed_sine);
  const nsvcd__v least_cosine = nsvcd__v_min(cosine, fixed_cosine);
  const nsvcd__v apart = nsvcd__v3_length(nsvcd__v3_sub(half, fixed_half));
  const nsvcd__v difference = nsvcd__v_pick(least_cosine, nsvcd__v_set(0.001f), sines, apart);
  // A rotation vector is 2 asin(s) / s times these halves of length s, and asin(s) - s is at most
  // (pi / 2 - 1) s^3.
  const nsvcd__v square = nsvcd__v_mul(sine, sine);
  const nsvcd__v fixed_square = nsvcd__v_mul(fixed_sine, fixed_sine);
  const nsvcd__v cubes = nsvcd__v_fma(square, sine, nsvcd__v_mul(fixed_square, fixed_sine));
  nsvcd__v turn = nsvcd__v_scale(difference, 2.00001f);
  turn = nsvcd__v_fma(nsvcd__v_set(1.1417f), cubes, turn);
  turn = nsvcd__v_fma(nsvcd__v_set(2e-6f), sines, turn);
  const nsvcd__v fixed_turn = nsvcd__v_arc(from->fixed, to->fixed);
  const nsvcd__v squares = nsvcd__v_mul(turn, nsvcd__v_add(turn, fixed_turn));
  nsvcd__v_keep_most(cut->most.arc_bulge + l, nsvcd__v_mul(squares, eighth));

  const nsvcd__v remote_start = nsvcd__v3_length(from->offset);
  const nsvcd__v remote = nsvcd__v_max(remote_start, nsvcd__v3_length(to->offset));
  const nsvcd__v way = nsvcd__v3_length(nsvcd__v3_sub(to->offset, from->offset));
  const nsvcd__v both = nsvcd__v_fma(fixed_turn, remote, nsvcd__v_add(way, way));
  const nsvcd__v metres = nsvcd__v_mul(nsvcd__v_mul(fixed_turn, both), eighth);
  const nsvcd__v drift = nsvcd__v_div(metres, nsvcd__v_set(motion->unit));
  nsvcd__v_keep_most(cut->most.arc_drift + l, drift);
  nsvcd__v_add_to(cut->most.sum + l, fixed_turn);
}

// Adds the arc from the last knot to this one, which becomes the last. seen: its rotation as the
// fixed body sees it.
static void nsvcd__cut_arc(const nsvcd__motion *motion, const nsvcd__v_poses *at,
                           nsvcd__vquat seen, size_t l, nsvcd__segments *out,
                           nsvcd__cut *cut) {
  const nsvcd__v_poses last = nsvcd__knots_load(motion, &cut->last, l);
  const nsvcd__v arc = nsvcd__v_arc(last.moving, at->moving);
  nsvcd__v_add_to(cut->most.sum + l, arc);
  if (motion->fixed_moves) {
    nsvcd__cut_double_arc(motion, &last, at, l, cut);
  } else {
    const nsvcd__v3 axis = nsvcd__v3_load(out->axis, l);
    const nsvcd__vquat last_seen = nsvcd__vquat_load(cut->last.seen + l, NSVCD__KNOTS);
    const nsvcd__v bulge = nsvcd__v_scale(nsvcd__v_mul(arc, arc), 0.125f);
    const nsvcd__v off_axis = nsvcd__v_turn_off_axis(axis, last_seen, seen, arc);
    nsvcd__v_keep_most(cut->most.arc_bulge + l, bulge);
    nsvcd__v_keep_most(cut->most.axis_turn + l, off_axis);
  }
  nsvcd__knots_keep(motion, at, seen, l, &cut->last);
}

// Visits a knot of each segment: ticks (16), of segments that begin at begin[0..15] and end at
// begin[1..16]. Adds the arc up to it, and what it is off its segment's chord by.
static NSVCD__APART void nsvcd__cut_knot(const nsvcd__motion *motion, const uint32_t *begin,
                                         const uint32_t *ticks, nsvcd__segments *out,
                                         nsvcd__cut *cut) {
  nsvcd__bends *most = &cut->most;
  // of the segment, before the knot
  float share[NSVCD__LANES];
  nsvcd__knots_read(motion, ticks, NSVCD__LANES, &cut->here);
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const uint32_t length = begin[l + 1] - begin[l];
    share[l] = length ? (float)(ticks[l] - begin[l]) / (float)length : 0;
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__knots_load(motion, &cut->here, l);
    const nsvcd__v_pose seen = nsvcd__v_seen(motion, &at);
    nsvcd__cut_arc(motion, &at, seen.rotation, l, out, cut);
    const nsvcd__v u = nsvcd__v_load(share + l);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__vmat3 turned = nsvcd__vmat3_load(out->turned, l);
    const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
    const nsvcd__vmat3 scaled = nsvcd__vmat3_scale(rotation, nsvcd__v_set(motion->scale));
    const nsvcd__vmat3 off = nsvcd__vmat3_sub(scaled, nsvcd__vmat3_fma(u, turned, start));
    const nsvcd__v3 position = nsvcd__v3_load(out->position, l);
    const nsvcd__v3 chord = nsvcd__v3_fma(u, nsvcd__v3_load(out->moved, l), position);
    const nsvcd__v3 aside = nsvcd__v3_sub(seen.position, chord);
    nsvcd__v_keep_most(most->bulge + l, nsvcd__vmat3_square(off));
    nsvcd__v_keep_most(most->spread + l, nsvcd__v3_dot(aside, aside));

    const nsvcd__v3 axis = nsvcd__v3_load(out->axis, l);
    const nsvcd__v3 along = nsvcd__vmat3_apply_transpose(off, axis);
    const nsvcd__v3 off_way = nsvcd__v3_cross(nsvcd__v3_load(out->way, l), aside);
    const nsvcd__v off_axis = nsvcd__v3_dot(axis, aside);
    nsvcd__v_keep_most(most->axis_bulge + l, nsvcd__v3_dot(along, along));
    nsvcd__v_keep_most(most->axis_drift + l, nsvcd__v_mul(off_axis, off_axis));
    nsvcd__v_keep_most(most->way_drift + l, nsvcd__v3_dot(off_way, off_way));
  }
}

// The deviations of segments whose knots have all been visited.
static void nsvcd__cut_deviations(const nsvcd__motion *motion, float lengths, size_t l,
                                  nsvcd__segments *out, const nsvcd__cut *cut) {
  const nsvcd__bends *most = &cut->most;
  const nsvcd__v scale = nsvcd__v_set(motion->scale);
  const nsvcd__v off_chord = nsvcd__v_sqrt(nsvcd__v_load(most->spread + l));
  const nsvcd__v drift = nsvcd__v_add(off_chord, nsvcd__v_load(most->arc_drift + l));
  const nsvcd__v arc_bulge = nsvcd__v_mul(scale, nsvcd__v_load(most->arc_bulge + l));
  const nsvcd__v knot_bulge = nsvcd__v_sqrt(nsvcd__v_load(most->bulge + l));
  const nsvcd__v bulge = nsvcd__v_add(arc_bulge, knot_bulge);
  nsvcd__v bulge_along_axis = bulge;
  nsvcd__v drift_along_axis = drift;
  nsvcd__v drift_off_way = drift;
  if (!motion->fixed_moves) {
    const nsvcd__v axis_turn = nsvcd__v_mul(scale, nsvcd__v_load(most->axis_turn + l));
    const nsvcd__v axis_bulge = nsvcd__v_sqrt(nsvcd__v_load(most->axis_bulge + l));
    bulge_along_axis = nsvcd__v_add(axis_bulge, axis_turn);
    drift_along_axis = nsvcd__v_sqrt(nsvcd__v_load(most->axis_drift + l));
    drift_off_way = nsvcd__v_sqrt(nsvcd__v_load(most->way_drift + l));
  }
  nsvcd__v_store(out->bulge + l, bulge);
  nsvcd__v_store(out->drift + l, drift);
  nsvcd__v_store(out->bulge_along_axis + l, bulge_along_axis);
  nsvcd__v_store(out->drift_along_axis + l, drift_along_axis);
  nsvcd__v_store(out->drift_off_way + l, drift_off_way);

  const nsvcd__v3 start = nsvcd__v3_load(out->position, l);
  const nsvcd__v3 end = nsvcd__v3_add(start, nsvcd__v3_load(out->moved, l));
  const nsvcd__v remote = nsvcd__v_add(nsvcd__v3_length(start), nsvcd__v3_length(end));
  const nsvcd__v all = nsvcd__v_add(remote, nsvcd__v_plus(drift, lengths));
  const nsvcd__v rounding = nsvcd__v_scale(all, NSVCD__ROUNDING);
  nsvcd__v_store(out->rounding + l, rounding);
  nsvcd__v_store(out->spread + l, nsvcd__v_add(rounding, drift));
}

// Cuts 16 segments, of which `count` exist. begin: (17) ticks at which they begin, and the last one
// ends. turn: (16) the angle by which each turns.
static void nsvcd__cut_block(const nsvcd__motion *motion, const uint32_t *begin, size_t count,
                             float lengths, nsvcd__segments *out, nsvcd__cut *cut,
                             float *turn) {
  uint32_t ticks[NSVCD__LANES];
  nsvcd__cut_starts(motion, begin, out, cut);
  nsvcd__cut_ends(motion, out, cut);
  memcpy(ticks, begin, sizeof ticks);
  for (int within = 1; within;) {
    within = 0;
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      const uint32_t next =
          ticks[l] < begin[l + 1] ? nsvcd__next_knot(motion, ticks[l]) : begin[l + 1];
      ticks[l] = next < begin[l + 1] ? next : begin[l + 1];
      within |= ticks[l] < begin[l + 1];
    }
    if (within) nsvcd__cut_knot(motion, begin, ticks, out, cut);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses end = nsvcd__knots_load(motion, &cut->end, l);
    const nsvcd__vquat seen = nsvcd__vquat_load(cut->end.seen + l, NSVCD__KNOTS);
    nsvcd__cut_arc(motion, &end, seen, l, out, cut);
    nsvcd__cut_deviations(motion, lengths, l, out, cut);
  }
  memcpy(turn, cut->most.sum, sizeof cut->most.sum);
  // these meet nothing
  for (size_t l = count; l < NSVCD__LANES; l++) out->spread[l] = NSVCD__NOWHERE;
}

// Chooses the segments: how many, and when they begin.
static void nsvcd__choose_segments(nsvcd__motion *motion, nsvcd__search *search) {
  uint32_t parts;
  nsvcd__motion_set_ticks(motion, 1);
  search->segments = nsvcd__segment_count(motion, search->most_segments, &parts);
  search->scale = motion->scale;
  nsvcd__motion_set_ticks(motion, parts);
  const uint32_t segments = (uint32_t)search->segments;
  const uint32_t each = motion->ticks / segments;
  const uint32_t over = motion->ticks % segments;
  uint32_t tick = 0;
  uint32_t rest = 0;
  for (size_t s = 0; s <= segments; s++) {
    search->begin[s] = tick;
    rest += over;
    tick += each + (rest >= segments);
    rest -= rest >= segments ? segments : 0;
  }
  nsvcd__motion_retime(motion, search->begin, segments);
  const double per_tick = 1 / (double)motion->ticks;
  for (size_t s = 0; s < segments; s++)
    search->time[s] = (float)((double)search->begin[s] * per_tick);
  search->time[segments] = 1;
}

// Fills the blocks: the chosen segments' poses in the fixed body's frame, and deviations. lengths:
// the bodies' extents; clearance: spheres that come so near are to count as meeting.
static void nsvcd__cut_segments(const nsvcd__motion *motion, float lengths, float clearance,
                                nsvcd__search *search) {
  search->turn[0] = 0;
  for (size_t first = 0; first < search->segments; first += NSVCD__LANES) {
    const size_t left = search->segments - first;
    const size_t count = left < NSVCD__LANES ? left : NSVCD__LANES;
    uint32_t ends[NSVCD__LANES + 1];
    float turn[NSVCD__LANES];
    for (size_t l = 0; l <= NSVCD__LANES; l++)
      ends[l] = search->begin[first + (l < count ? l : count)];
    nsvcd__segments *block = &search->blocks[first / NSVCD__LANES];
    nsvcd__cut_block(motion, ends, count, lengths, block, search->cut, turn);
    for (size_t l = 0; l < count; l++) block->spread[l] += clearance;
    for (size_t l = 0; l < count; l++)
      search->turn[first + l + 1] = search->turn[first + l] + turn[l];
  }
}

#ifndef NSVCD_NO_NETWORK
static NSVCD__APART void nsvcd__cut_motion(nsvcd__motion *motion, float lengths,
                                           nsvcd__search *search) {
  nsvcd__choose_segments(motion, search);
  nsvcd__cut_segments(motion, lengths, 0, search);
}
#endif

// Stores a slice of chords, from lane l on. FLT_MIN keeps a chord of no length finite.
static void nsvcd__chords_store(nsvcd__chords *c, size_t l, nsvcd__v3 start, nsvcd__v3 way,
                                nsvcd__v reach) {
  const nsvcd__v square = nsvcd__v_max(nsvcd__v3_dot(way, way), nsvcd__v_set(1.2e-38f));
  nsvcd__v3_store(c->start, l, start);
  nsvcd__v3_store(c->way, l, way);
  nsvcd__v_store(c->inverse + l, nsvcd__v_div(nsvcd__v_set(-1), square));
  nsvcd__v_store(c->reach + l, reach);
}

// Chords of one sphere, body frame, in the segments of a block.
static void nsvcd__chords_of_sphere(nsvcd__segments *b, nsvcd__sphere sphere,
                                    nsvcd__chords *out) {
  const nsvcd__v3 centre = nsvcd__v3_set(sphere.centre);
  const nsvcd__v length = nsvcd__v_set(nsvcd__f3_length(sphere.centre));
  const nsvcd__v radius = nsvcd__v_set(sphere.radius);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__vmat3 rotation = nsvcd__vmat3_load(b->rotation, l);
    const nsvcd__vmat3 turned = nsvcd__vmat3_load(b->turned, l);
    const nsvcd__v3 position = nsvcd__v3_load(b->position, l);
    const nsvcd__v3 moved = nsvcd__v3_load(b->moved, l);
    const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotation, centre, position);
    const nsvcd__v3 way = nsvcd__vmat3_apply_add(turned, centre, moved);
    const nsvcd__v spread = nsvcd__v_load(b->spread + l);
    const nsvcd__v deviation = nsvcd__v_fma(nsvcd__v_load(b->bulge + l), length, spread);
    nsvcd__chords_store(out, l, start, way, nsvcd__v_add(deviation, radius));
  }
}

// Chords of 16 spheres in one segment: lane s of a block. The patches that they contain are no
// farther than `remote` from the body's origin, in its own frame and units; scale: of the body. The
// centre of a sphere over patches may be farther: on their chords points of a body do not move
// apart, so that it is enough to allow for what the patches deviate.
static void nsvcd__chords_of_members(nsvcd__segments *b, size_t s, nsvcd__spheres members,
                                     float scale, float remote, nsvcd__chords *out) {
  const nsvcd__v deviation = nsvcd__v_set(b->spread[s] + b->bulge[s] * remote);
  const nsvcd__mat3 rotation = nsvcd__mat3_lane(b->rotation, s);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(b->turned, s);
  const nsvcd__v3 position = nsvcd__v3_set(nsvcd__lane_of(b->position, s));
  const nsvcd__v3 moved = nsvcd__v3_set(nsvcd__lane_of(b->moved, s));
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(members, l);
    const nsvcd__vmat3 rotations = nsvcd__vmat3_set(&rotation);
    const nsvcd__vmat3 turns = nsvcd__vmat3_set(&turned);
    const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotations, centre, position);
    const nsvcd__v3 way = nsvcd__vmat3_apply_add(turns, centre, moved);
    const nsvcd__v radius = nsvcd__v_load(members.r + l);
    const nsvcd__v reach = nsvcd__v_fma(nsvcd__v_set(scale), radius, deviation);
    nsvcd__chords_store(out, l, start, way, reach);
  }
}

// The square of a sum of radii, with its sign: a negative sum (padding) meets nothing.
static inline nsvcd__v nsvcd__v_signed_square(nsvcd__v reach) {
  return nsvcd__v_mul(reach, nsvcd__v_max(reach, nsvcd__v_sub(nsvcd__v_set(0), reach)));
}

// Squared distance of the chord from the resting centre. d: from that centre to the start of the
// chord.
NSVCD__INLINE nsvcd__v nsvcd__nearest2(nsvcd__v3 d, nsvcd__v3 way, nsvcd__v inverse) {
  const nsvcd__v tau = nsvcd__v_clamp(nsvcd__v_mul(nsvcd__v3_dot(d, way), inverse), 0, 1);
  const nsvcd__v3 nearest = nsvcd__v3_fma(tau, way, d);
  return nsvcd__v3_dot(nearest, nearest);
}

// The test. A bit for each lane of the slice: does the chord come within `reach` of the resting
// centre? d: from that to the start of the chord.
NSVCD__INLINE uint32_t nsvcd__comes_within(nsvcd__v3 d, nsvcd__v3 way, nsvcd__v inverse,
                                           nsvcd__v reach) {
  return nsvcd__v_le(nsvcd__nearest2(d, way, inverse), nsvcd__v_signed_square(reach));
}

NSVCD__INLINE nsvcd__v3 nsvcd__chords_start(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->start[0] + l);
}
NSVCD__INLINE nsvcd__v3 nsvcd__chords_way(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->way[0] + l);
}

// 16 moving spheres, or one in 16 segments, against one resting sphere.
static uint32_t nsvcd__meet(const nsvcd__chords *c, nsvcd__sphere resting) {
  const nsvcd__v3 centre = nsvcd__v3_set(resting.centre);
  const nsvcd__v radius = nsvcd__v_set(resting.radius);
  uint32_t met = 0;
  NSVCD__TALLY(tests, 1);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v reach = nsvcd__v_add(nsvcd__v_load(c->reach + l), radius);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    met |= nsvcd__comes_within(d, nsvcd__chords_way(c, l), inverse, reach) << l;
  }
  return met;
}

// Lane s of chords against 16 resting spheres.
static uint32_t nsvcd__meet_members(const nsvcd__chords *c, size_t s, nsvcd__spheres resting) {
  const nsvcd__v3 start = nsvcd__v3_set(nsvcd__f3_get(c->start[0] + s, NSVCD__LANES));
  const nsvcd__v3 way = nsvcd__v3_set(nsvcd__f3_get(c->way[0] + s, NSVCD__LANES));
  const nsvcd__v inverse = nsvcd__v_set(c->inverse[s]);
  const nsvcd__v own = nsvcd__v_set(c->reach[s]);
  uint32_t met = 0;
  NSVCD__TALLY(tests, 1);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_centres(resting, l));
    const nsvcd__v reach = nsvcd__v_add(own, nsvcd__v_load(resting.r + l));
    met |= nsvcd__comes_within(d, way, inverse, reach) << l;
  }
  return met;
}

// The segments among `wanted` in which a sphere with chords[] (one block per 16 segments) meets a
// resting one.
static uint64_t nsvcd__meet_in(const nsvcd__chords *chords, uint64_t wanted,
                               nsvcd__sphere resting) {
  uint64_t met = 0;
  for (size_t block = 0; block < NSVCD__BLOCKS && wanted >> (NSVCD__LANES * block); block++) {
    const size_t shift = NSVCD__LANES * block;
    if (wanted >> shift & 0xffff)
      met |= (uint64_t)nsvcd__meet(&chords[block], resting) << shift;
  }
  return met & wanted;
}

// ================================================================== search: which patches may meet

// -------------------------------------------------------------------------------- search/intervals
// In: chords of a patch, and the patches of the other body. Out: candidates, with the time in which
// their balls meet.

#ifndef NSVCD_NO_NETWORK
// The candidates kept so far: a heap with the shallowest at its root, and the count of all
// intervals.
typedef struct nsvcd__candidates {
  // (limit), the caller's
  nsvcd__candidate *items;
  size_t limit, count;
  // intervals found, kept or not; 0: certified free
  size_t total;
} nsvcd__candidates;

// A total order, so that ties do not depend on the order in which intervals were found.
static int nsvcd__is_shallower(const nsvcd__candidate *a, const nsvcd__candidate *b) {
  if (a->depth < b->depth || a->depth > b->depth) return a->depth < b->depth;
  if (a->moving != b->moving) return a->moving > b->moving;
  if (a->fixed != b->fixed) return a->fixed > b->fixed;
  return a->t_enter > b->t_enter;
}

// Counts an interval, and keeps it where there is room, or where the shallowest one can make some.
static void nsvcd__candidates_add(nsvcd__candidates *kept, const nsvcd__candidate *item) {
  nsvcd__candidate *heap = kept->items;
  size_t hole = 0;
  kept->total++;
  if (kept->count < kept->limit) {
    for (hole = kept->count++; hole > 0; hole = (hole - 1) / 2) {
      if (!nsvcd__is_shallower(item, &heap[(hole - 1) / 2])) break;
      heap[hole] = heap[(hole - 1) / 2];
    }
  } else {
    if (kept->limit == 0 || !nsvcd__is_shallower(&heap[0], item)) return;
    for (size_t child = 1; child < kept->count; child = 2 * hole + 1) {
      if (child + 1 < kept->count && nsvcd__is_shallower(&heap[child + 1], &heap[child]))
        child++;
      if (!nsvcd__is_shallower(&heap[child], item)) break;
      heap[hole] = heap[child];
      hole = child;
    }
  }
  heap[hole] = *item;
}

// Contact intervals of a slice that are still growing, one per lane. Places on a segment's line are
// counted in segments from its start: `nearest` is where the line comes nearest to the other
// centre. The spheres touch from `nearest` - h to `nearest` + h; half2 is the square of h.
typedef struct nsvcd__intervals {
  uint32_t open;  // lanes
  // segments: in which the oldest of them began, and the last that all of them reach
  size_t oldest, last;
  // 1 in lanes without an interval, else 0
  nsvcd__v fresh;
  nsvcd__v first, first_nearest, first_half2, last_nearest, last_half2;
  // of the least distance: its square, and where
  nsvcd__v square, least_segment, least;
} nsvcd__intervals;

// The time at a share of segment s: at 1 that of its end, to the bit.
static float nsvcd__time_in_segment(const nsvcd__search *search, size_t s, float share) {
  const float start = search->time[s];
  const float end = search->time[s + 1];
  return share < 1 ? start + share * (end - start) : end;
}

// Ends the intervals of `lanes` of a slice and hands them on. Its first lane is patch i of the
// moving body; j: the patch of the fixed one.
static void nsvcd__intervals_close(nsvcd__intervals *intervals, uint32_t lanes,
                                   const nsvcd__search *search, size_t i, size_t j,
                                   nsvcd__candidates *kept) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v own = nsvcd__v_load(nsvcd__body_r(search->moving) + i);
  const nsvcd__v other = nsvcd__v_set(nsvcd__body_r(search->fixed)[j]);
  const nsvcd__v scaled = nsvcd__v_scale(own, search->scale);
  const nsvcd__v radii = nsvcd__v_max(nsvcd__v_add(scaled, other), nsvcd__v_set(1e-30f));
  intervals->open &= ~lanes;
  // most are shallower than all of a full heap: only counted
  if (kept->count == kept->limit) {
    const float depth = kept->limit ? (1 - kept->items[0].depth) * 1.000001f : 0;
    const nsvcd__v most = nsvcd__v_scale(radii, depth > 0 ? depth : 0);
    uint32_t deep = 0;
    if (kept->limit) deep = lanes & nsvcd__v_le(intervals->square, nsvcd__v_mul(most, most));
    kept->total += nsvcd__bit_count(lanes & ~deep);
    lanes = deep;
    if (!lanes) return;
  }

  float first[NSVCD__SLICE], enter[NSVCD__SLICE], leave[NSVCD__SLICE];
  float least_segment[NSVCD__SLICE], least[NSVCD__SLICE], depth[NSVCD__SLICE];
  const nsvcd__v before = nsvcd__v_sqrt(nsvcd__v_max(intervals->first_half2, zero));
  const nsvcd__v after = nsvcd__v_sqrt(nsvcd__v_max(intervals->last_half2, zero));
  const nsvcd__v share = nsvcd__v_div(nsvcd__v_sqrt(intervals->square), radii);
  nsvcd__v_store(first, intervals->first);
  nsvcd__v_store(least_segment, intervals->least_segment);
  nsvcd__v_store(enter, nsvcd__v_max(nsvcd__v_sub(intervals->first_nearest, before), zero));
  nsvcd__v_store(leave, nsvcd__v_min(nsvcd__v_add(intervals->last_nearest, after), one));
  nsvcd__v_store(least, intervals->least);
  nsvcd__v_store(depth, nsvcd__v_sub(one, share));
  for (; lanes; lanes &= lanes - 1) {
    const size_t l = nsvcd__low_bit(lanes);
    nsvcd__candidate candidate;
    candidate.moving = (uint16_t)(i + l);
    candidate.fixed = (uint16_t)j;
    candidate.t_enter = nsvcd__time_in_segment(search, (size_t)first[l], enter[l]);
    candidate.t_exit = nsvcd__time_in_segment(search, intervals->last, leave[l]);
    candidate.t_least = nsvcd__time_in_segment(search, (size_t)least_segment[l], least[l]);
    candidate.depth = depth[l];
    candidate.score = NSVCD__NO_SCORE;
    // Rounding must not put the least distance outside.
    if (candidate.t_enter > candidate.t_least) candidate.t_enter = candidate.t_least;
    if (candidate.t_exit < candidate.t_least) candidate.t_exit = candidate.t_least;
    nsvcd__candidates_add(kept, &candidate);
  }
}

// The segments before which all contact intervals of the members of a group against patch j of the
// fixed body are cut: the oldest of them would turn too far, or a segment is left out in between.
// Asked for all 16 beforehand, so that machines with narrower slices find the same intervals.
static uint64_t nsvcd__interval_cuts(const nsvcd__search *search, size_t j, uint64_t wanted) {
  const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(search->fixed), j);
  // where the segment before is left out
  uint64_t cuts = wanted & ~(wanted << 1);
  uint32_t open = 0;
  size_t oldest = 0;
  if (!(search->turn[search->segments] > NSVCD__INTERVAL_TURN)) return cuts;
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    const uint32_t met = nsvcd__meet(&search->members[s], patch);
    if (open && search->turn[s + 1] - search->turn[oldest] > NSVCD__INTERVAL_TURN)
      cuts |= (uint64_t)1 << s;
    if (cuts >> s & 1) open = 0;
    open &= met;
    if (!open) oldest = s;
    open = met;
  }
  return cuts;
}

// A slice of the moving patches, from patch i on, against patch j of the fixed body, in the
// segments `wanted`. cuts: nsvcd__interval_cuts; where a slice is all lanes, it finds that itself.
static void nsvcd__slice_against_patch(const nsvcd__search *search, size_t i, size_t j,
                                       uint64_t wanted, uint64_t cuts,
                                       nsvcd__candidates *kept) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(search->fixed), j);
  const nsvcd__v3 centre = nsvcd__v3_set(patch.centre);
  const size_t l = i % NSVCD__GROUP;
  nsvcd__intervals at = {0, 0, 0, one, zero, zero, zero, zero, zero, zero, zero, zero};
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    const nsvcd__chords *c = &search->members[s];
    const nsvcd__v3 way = nsvcd__chords_way(c, l);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    const nsvcd__v reach = nsvcd__v_plus(nsvcd__v_load(c->reach + l), patch.radius);
    // the square of the sum of radii; the line's nearest point, and the chord's, as places on them
    const nsvcd__v limit = nsvcd__v_signed_square(reach);
    const nsvcd__v nearest = nsvcd__v_mul(nsvcd__v3_dot(d, way), inverse);
    const nsvcd__v tau = nsvcd__v_clamp(nearest, 0, 1);
    const nsvcd__v3 chord = nsvcd__v3_fma(tau, way, d);
    const nsvcd__v square = nsvcd__v3_dot(chord, chord);
    const uint32_t met = nsvcd__v_le(square, limit);
    uint32_t ended = at.open & ~met;
    int cut = (int)(cuts >> s & 1);
    if (NSVCD__SLICE == NSVCD__LANES && at.open) {
      cut = search->turn[s + 1] - search->turn[at.oldest] > NSVCD__INTERVAL_TURN;
      cut |= at.last + 1 != s;
    }
    if (cut) {
      ended = at.open;
      at.fresh = one;
    }
    if (ended) nsvcd__intervals_close(&at, ended, search, i, j, kept);
    if (!met) {
      at.fresh = one;
      continue;
    }

    // Intervals go on, or begin. |d + tau way| = reach, solved from the nearest point of the line
    // outwards: b^2 - ac would cancel on long chords.
    const nsvcd__v segment = nsvcd__v_set((float)s);
    const nsvcd__v3 line = nsvcd__v3_fma(nearest, way, d);
    const nsvcd__v half2 =
        nsvcd__v_mul(nsvcd__v_sub(nsvcd__v3_dot(line, line), limit), inverse);
    const nsvcd__v before = nsvcd__v_pick(half, at.fresh, nsvcd__v_set(1e38f), at.square);
    at.first = nsvcd__v_pick(half, at.fresh, segment, at.first);
    at.first_nearest = nsvcd__v_pick(half, at.fresh, nearest, at.first_nearest);
    at.first_half2 = nsvcd__v_pick(half, at.fresh, half2, at.first_half2);
    at.last_nearest = nearest;
    at.last_half2 = half2;
    at.least_segment = nsvcd__v_pick(square, before, segment, at.least_segment);
    at.least = nsvcd__v_pick(square, before, tau, at.least);
    at.square = nsvcd__v_min(square, before);
    at.fresh = nsvcd__v_pick(square, limit, zero, one);
    if (!at.open) at.oldest = s;
    at.open = met;
    at.last = s;
  }
  if (at.open) nsvcd__intervals_close(&at, at.open, search, i, j, kept);
}

// The 16 members of moving group g against patch j of the fixed body, in the segments `wanted`.
static void nsvcd__members_against_patch(const nsvcd__search *search, size_t g, size_t j,
                                         uint64_t wanted, nsvcd__candidates *kept) {
  uint64_t cuts = 0;
  NSVCD__TALLY(tests, nsvcd__bit_count(wanted));
  if (NSVCD__SLICE < NSVCD__LANES) cuts = nsvcd__interval_cuts(search, j, wanted);
  NSVCD__EACH_SLICE(l) {
    nsvcd__slice_against_patch(search, NSVCD__GROUP * g + l, j, wanted, cuts, kept);
  }
}
#endif  // NSVCD_NO_NETWORK

// ----------------------------------------------------------------------------------- search/search
// In: two bodies and segments. Out: each pair of patches whose spheres meet, with the segments in
// which they do, group by group.

// Chords of a sphere of the moving body in all segments, into search->group.
static void nsvcd__chords_in_all(nsvcd__search *search, nsvcd__sphere sphere) {
  sphere.radius *= search->scale;
  for (size_t b = 0; NSVCD__LANES * b < search->segments; b++) {
    nsvcd__chords_of_sphere(&search->blocks[b], sphere, &search->group[b]);
  }
}

static void nsvcd__chords_of_group(nsvcd__search *search, size_t g) {
  nsvcd__chords_in_all(search, nsvcd__sphere_of(nsvcd__groups_of(search->moving), g));
}

// Chords of 16 spheres of the moving body in segment s. remote: as nsvcd__chords_of_members has it.
static void nsvcd__chords_in_segment(const nsvcd__search *search, size_t s,
                                     nsvcd__spheres spheres, float remote,
                                     nsvcd__chords *out) {
  nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  nsvcd__chords_of_members(block, s % NSVCD__LANES, spheres, search->scale, remote, out);
}

// Boxes in which 16 groups of the moving tile, from `first`, stay as long as they are near the
// fixed body: its axes, metres. Empty ones, low above high, for those that never are. wanted: the
// segments to look at.
static void nsvcd__boxes_of_groups(const nsvcd__search *search, size_t first, uint64_t wanted,
                                   nsvcd__boxes *out) {
  const nsvcd__spheres groups = nsvcd__spheres_from(search->moving_tile.spheres, first);
  const nsvcd__sphere fixed = nsvcd__body_sphere(search->fixed);
  nsvcd__chords *c = nsvcd__spare_chords(search);
  NSVCD__TALLY(tests, nsvcd__bit_count(wanted));
  for (size_t n = 0; n < 3 * NSVCD__LANES; n++) {
    out->low[n / NSVCD__LANES][n % NSVCD__LANES] = -NSVCD__NOWHERE;
    out->high[n / NSVCD__LANES][n % NSVCD__LANES] = NSVCD__NOWHERE;
  }
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    nsvcd__chords_in_segment(search, s, groups, search->moving->extent, c);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v nowhere = nsvcd__v_set(NSVCD__NOWHERE);
      const nsvcd__v3 start = nsvcd__chords_start(c, l);
      const nsvcd__v3 way = nsvcd__chords_way(c, l);
      const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_set(fixed.centre));
      const nsvcd__v reach = nsvcd__v_load(c->reach + l);
      const nsvcd__v sum = nsvcd__v_plus(reach, fixed.radius);
      const nsvcd__v square = nsvcd__nearest2(d, way, nsvcd__v_load(c->inverse + l));
      const nsvcd__v nearby =
          nsvcd__v_pick(square, nsvcd__v_signed_square(sum), reach, nowhere);
      const nsvcd__v3 end = nsvcd__v3_add(start, way);
      const nsvcd__v3 around = nsvcd__v3_of(nearby, nearby, nearby);
      const nsvcd__v3 low = nsvcd__v3_sub(nsvcd__v3_min(start, end), around);
      const nsvcd__v3 high = nsvcd__v3_add(nsvcd__v3_max(start, end), around);
      nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_load(out->low, l), low));
      nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_load(out->high, l), high));
    }
  }
}

// Lanes of 16 spheres that touch a box.
static uint32_t nsvcd__spheres_at_box(nsvcd__box box, nsvcd__spheres all) {
  const nsvcd__v3 none = nsvcd__v3_set(nsvcd__f3_of(0, 0, 0));
  uint32_t touched = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(all, l);
    const nsvcd__v3 below = nsvcd__v3_sub(nsvcd__v3_set(box.low), centre);
    const nsvcd__v3 above = nsvcd__v3_sub(centre, nsvcd__v3_set(box.high));
    const nsvcd__v3 d = nsvcd__v3_max(nsvcd__v3_max(below, above), none);
    const nsvcd__v reach = nsvcd__v_load(all.r + l);
    touched |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(reach)) << l;
  }
  return touched;
}

static uint64_t nsvcd__all_segments(const nsvcd__search *search) {
  return ~(uint64_t)0 >> (NSVCD__MAX_SEGMENTS - search->segments);
}

// Puts the steps of the search of both tiles in order: the groups of the moving tile that meet
// some of the fixed tile, those that meet most of them for most of the time first; nearby[g] says
// which, and in which segments. wanted: segments in which the bodies' spheres meet.
static void nsvcd__search_tile(nsvcd__search *search, uint64_t wanted) {
  uint16_t meetings[NSVCD__TILE_SLOTS];
  const nsvcd__tile *tile = &search->fixed_tile;
  nsvcd__boxes *boxes = nsvcd__spare_boxes(search);
  search->steps = 0;
  search->step = 0;
  search->waiting = 0;
  for (size_t g = 0; g < search->moving_tile.count; g++) {
    const size_t l = g % NSVCD__LANES;
    if (l == 0) nsvcd__boxes_of_groups(search, g, wanted, boxes);
    const nsvcd__box box = {nsvcd__lane_of(boxes->low, l), nsvcd__lane_of(boxes->high, l)};
    uint32_t groups = 0;
    for (size_t first = 0; first < tile->count; first += NSVCD__LANES)
      groups |= nsvcd__spheres_at_box(box, nsvcd__spheres_from(tile->spheres, first)) << first;
    if (!groups) continue;
    uint64_t *nearby = nsvcd__nearby(search, g);
    size_t count = 0;
    nsvcd__chords_of_group(search, search->moving_tile.groups[g]);
    memset(nearby, 0, tile->count * sizeof *nearby);
    for (; groups; groups &= groups - 1) {
      const size_t h = nsvcd__low_bit(groups);
      const nsvcd__sphere resting = nsvcd__sphere_of(tile->spheres, h);
      nearby[h] = nsvcd__meet_in(search->group, nsvcd__all_segments(search), resting);
      count += nsvcd__bit_count(nearby[h]);
    }
    if (!count) continue;
    size_t at = search->steps;
    for (; at > 0 && meetings[at - 1] < count; at--) {
      meetings[at] = meetings[at - 1];
      search->order[at] = search->order[at - 1];
    }
    meetings[at] = (uint16_t)count;
    search->order[at] = (uint16_t)g;
    search->steps++;
  }
}

static int nsvcd__is_large(const nsvcd_body *body) {
  return nsvcd__body_groups(body) > NSVCD__TILE;
}
// Are there several tiles?
static int nsvcd__is_tiled(const nsvcd_body *a, const nsvcd_body *b) {
  return nsvcd__is_large(a) || nsvcd__is_large(b);
}

// Fills a tile with the next groups that a walk finds.
static void nsvcd__tile_fill(nsvcd__tile *tile, nsvcd__walk *walk) {
  size_t g;
  tile->spheres = nsvcd__spheres_of(tile->gathered, NSVCD__TILE_SLOTS);
  for (size_t n = 0; n < 4 * NSVCD__TILE_SLOTS; n++)
    tile->gathered[n] = n < 3 * NSVCD__TILE_SLOTS ? 0 : NSVCD__NOWHERE;
  tile->count = 0;
  while (tile->count < NSVCD__TILE && nsvcd__walk_next(walk, &g)) {
    const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(walk->body), g);
    nsvcd__sphere_store(group, tile->gathered, NSVCD__TILE_SLOTS, tile->count);
    tile->groups[tile->count++] = (uint16_t)g;
  }
}

// Fills a tile with all groups of a body that has no more than that.
static void nsvcd__tile_fill_all(nsvcd__tile *tile, const nsvcd_body *body) {
  tile->count = nsvcd__body_groups(body);
  for (size_t g = 0; g < tile->count; g++) tile->groups[g] = (uint16_t)g;
  tile->spheres = nsvcd__groups_of(body);
}

// ---- filters of a walk, which are given the search

// All spheres that there are.
static uint32_t nsvcd__exists(const void *what, nsvcd__spheres all) {
  uint32_t exists = 0;
  (void)what;
  NSVCD__EACH_SLICE(l) exists |= nsvcd__v_le(nsvcd__v_set(0), nsvcd__v_load(all.r + l)) << l;
  return exists;
}

// Spheres of the moving body that meet that of the fixed one.
static uint32_t nsvcd__comes_near(const void *what, nsvcd__spheres all) {
  const nsvcd__search *search = (const nsvcd__search *)what;
  const nsvcd__sphere fixed = nsvcd__body_sphere(search->fixed);
  nsvcd__chords *chords = nsvcd__spare_chords(search);
  uint32_t met = 0;
  for (uint64_t wanted = search->near_segments; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    nsvcd__chords_in_segment(search, s, all, search->moving->extent, chords);
    met |= nsvcd__meet(chords, fixed);
  }
  return met;
}

// Spheres of the fixed body that meet that of the moving tile, whose chords are search->group.
static uint32_t nsvcd__is_approached(const void *what, nsvcd__spheres all) {
  const nsvcd__search *search = (const nsvcd__search *)what;
  const uint32_t nearby = nsvcd__spheres_at_box(search->near_box, all);
  uint32_t met = 0;
  for (uint64_t wanted = search->near_segments; wanted && nearby & ~met;
       wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    const nsvcd__chords *chords = &search->group[s / NSVCD__LANES];
    met |= nearby & nsvcd__meet_members(chords, s % NSVCD__LANES, all);
  }
  return met;
}

// Poses the sphere over all groups of the moving tile, into search->group.
static void nsvcd__chords_of_tile(nsvcd__search *search) {
  const nsvcd__tile *tile = &search->moving_tile;
  nsvcd__sphere sphere = nsvcd__body_sphere(search->moving);
  if (nsvcd__is_large(search->moving))
    sphere = nsvcd__cover_spheres(tile->spheres, tile->count);
  nsvcd__chords_in_all(search, sphere);
}

// Finds the next moving tile, an empty one if there is none, and starts the walk through the fixed
// body's groups that come near it: that touch a box about its chords.
static void nsvcd__search_moving_tile(nsvcd__search *search) {
  nsvcd__box box = {{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
  nsvcd__tile_fill(&search->moving_tile, &search->moving_walk);
  if (search->moving_tile.count == 0) return;
  nsvcd__chords_of_tile(search);
  for (uint64_t left = search->near_segments; left; left &= left - 1) {
    const size_t s = nsvcd__low_bit(left);
    const nsvcd__chords *c = &search->group[s / NSVCD__LANES];
    const size_t l = s % NSVCD__LANES;
    const nsvcd__f3 start = nsvcd__f3_get(c->start[0] + l, NSVCD__LANES);
    const nsvcd__f3 way = nsvcd__f3_get(c->way[0] + l, NSVCD__LANES);
    const nsvcd__f3 end = nsvcd__f3_add(start, way);
    const nsvcd__f3 around = nsvcd__f3_of(c->reach[l], c->reach[l], c->reach[l]);
    const nsvcd__f3 low = nsvcd__f3_sub(nsvcd__f3_min(start, end), around);
    const nsvcd__f3 high = nsvcd__f3_add(nsvcd__f3_max(start, end), around);
    box.low = nsvcd__f3_min(box.low, low);
    box.high = nsvcd__f3_max(box.high, high);
  }
  search->near_box = box;
  nsvcd__walk_begin(&search->fixed_walk, search->fixed, nsvcd__is_approached, search);
}

// Goes on to the next tile that has a step. 0 if there is none.
static int nsvcd__search_next_tile(nsvcd__search *search) {
  if (!nsvcd__is_tiled(search->moving, search->fixed)) return 0;
  while (search->moving_tile.count > 0) {
    nsvcd__chords_of_tile(search);
    nsvcd__tile_fill(&search->fixed_tile, &search->fixed_walk);
    if (search->fixed_tile.count == 0) {
      nsvcd__search_moving_tile(search);
      continue;
    }
    nsvcd__search_tile(search, search->near_segments);
    if (search->steps > 0) return 1;
  }
  return 0;
}

// Starts the search of a motion that has been cut, in some of its segments. Returns 0 if the
// groups' spheres never meet there: then there is no step to take.
static int nsvcd__search_begin(const nsvcd_body *moving, const nsvcd_body *fixed,
                               uint64_t segments, nsvcd__search *search) {
  search->moving = moving;
  search->fixed = fixed;
  nsvcd__chords_in_all(search, nsvcd__body_sphere(moving));
  const uint64_t all = segments & nsvcd__all_segments(search);
  const uint64_t wanted = nsvcd__meet_in(search->group, all, nsvcd__body_sphere(fixed));
  search->near_segments = wanted;
  search->wanted = segments;
  search->steps = 0;
  search->step = 0;
  search->waiting = 0;
  if (!nsvcd__is_tiled(moving, fixed)) {
    nsvcd__tile_fill_all(&search->moving_tile, moving);
    nsvcd__tile_fill_all(&search->fixed_tile, fixed);
    if (wanted) nsvcd__search_tile(search, wanted);
    return search->steps > 0;
  }
  search->moving_tile.count = 0;
  if (!wanted) return 0;
  nsvcd__filter *filter = nsvcd__is_large(moving) ? nsvcd__comes_near : nsvcd__exists;
  nsvcd__walk_begin(&search->moving_walk, moving, filter, search);
  nsvcd__search_moving_tile(search);
  return nsvcd__search_next_tile(search);
}

// No point of a group is farther from its body's origin; in the body's own units.
static float nsvcd__group_reach(const nsvcd_body *body, size_t g) {
  const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(body), g);
  return 1.000002f * (nsvcd__f3_length(group.centre) + group.radius);
}

// Fills members[] with what is missing of the segments `wanted`.
static void nsvcd__pose_members(nsvcd__search *search, size_t g, uint64_t wanted) {
  if (!(wanted & ~search->posed)) return;
  const nsvcd__spheres patches = nsvcd__body_patches(search->moving);
  const nsvcd__spheres members = nsvcd__spheres_from(patches, NSVCD__GROUP * g);
  search->remote = nsvcd__group_reach(search->moving, g);
  for (uint64_t missing = wanted & ~search->posed; missing; missing &= missing - 1) {
    const size_t s = nsvcd__low_bit(missing);
    nsvcd__chords_in_segment(search, s, members, search->remote, &search->members[s]);
  }
  search->posed |= wanted;
}

// Patches of group h of the fixed body that moving group g meets, and in which segments, of those
// `wanted`: segments (GROUP), written for these patches.
static uint32_t nsvcd__group_against_members(const nsvcd__search *search, size_t h,
                                             uint64_t wanted, uint64_t *segments) {
  const nsvcd__spheres patches = nsvcd__body_patches(search->fixed);
  const nsvcd__spheres members = nsvcd__spheres_from(patches, NSVCD__GROUP * h);
  uint32_t met = 0;
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    const nsvcd__chords *chords = &search->group[s / NSVCD__LANES];
    uint32_t bits = nsvcd__meet_members(chords, s % NSVCD__LANES, members);
    for (; bits; bits &= bits - 1) {
      const size_t l = nsvcd__low_bit(bits);
      segments[l] = (met >> l & 1 ? segments[l] : 0) | (uint64_t)1 << s;
      met |= 1u << l;
    }
  }
  return met;
}

// Turns to the moving group that is next in order. Returns the fixed group, its place in the tile,
// that it meets for the longest time.
static size_t nsvcd__search_group(nsvcd__search *search) {
  const size_t g = search->order[search->step];
  const uint64_t *nearby = nsvcd__nearby(search, g);
  size_t longest = 0;
  size_t most = 0;
  for (size_t h = 0; h < search->fixed_tile.count; h++) {
    const size_t count = nsvcd__bit_count(nearby[h] & search->wanted);
    if (count > 0) search->waiting |= (uint32_t)1 << h;
    if (count > most) {
      most = count;
      longest = h;
    }
  }
  if (search->waiting) nsvcd__chords_of_group(search, search->moving_tile.groups[g]);
  search->posed = 0;
  return longest;
}

#ifndef NSVCD_NO_NETWORK
// A step of the search: all contact intervals of one pair of groups. Returns 1 if there are more
// steps to take.
static NSVCD__APART int nsvcd__search_step(nsvcd__search *search, nsvcd__candidates *kept) {
  uint64_t segments[NSVCD__GROUP];
  size_t at;
  if (search->waiting)
    at = nsvcd__low_bit(search->waiting);
  else
    at = nsvcd__search_group(search);
  const size_t next = search->order[search->step];
  const size_t g = search->moving_tile.groups[next];
  const size_t h = search->fixed_tile.groups[at];
  const uint64_t wanted = nsvcd__nearby(search, next)[at];
  uint32_t met = nsvcd__group_against_members(search, h, wanted, segments);
  for (; met; met &= met - 1) {
    const size_t l = nsvcd__low_bit(met);
    nsvcd__pose_members(search, g, segments[l]);
    nsvcd__members_against_patch(search, g, NSVCD__GROUP * h + l, segments[l], kept);
  }
  search->waiting &= ~((uint32_t)1 << at);
  if (!search->waiting) search->step++;
  return search->step < search->steps || nsvcd__search_next_tile(search);
}

// Instead of a search, in a motion that has been cut: all contact intervals of one moving group and
// one patch of the fixed body.
static void nsvcd__search_patch(nsvcd__search *search, const nsvcd_body *moving, size_t g,
                                const nsvcd_body *fixed, size_t j, nsvcd__candidates *kept) {
  const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(fixed), j);
  search->moving = moving;
  search->fixed = fixed;
  nsvcd__chords_of_group(search, g);
  const uint64_t wanted = nsvcd__meet_in(search->group, nsvcd__all_segments(search), patch);
  search->posed = 0;
  nsvcd__pose_members(search, g, wanted);
  nsvcd__members_against_patch(search, g, j, wanted, kept);
}

static void nsvcd__candidates_start(nsvcd__candidates *kept, nsvcd__candidate *items,
                                    size_t limit) {
  kept->items = items;
  kept->limit = limit;
  kept->count = 0;
  kept->total = 0;
}

#endif  // NSVCD_NO_NETWORK

// ==================================================================== proof: whether surfaces meet

// ------------------------------------------------------------------------------------- proof/proof
// In: two bodies of triangles and a motion. Out: a witness (two triangles that meet, and when), a
// certificate that the surfaces never do, or neither: undecided.
//
// THEOREM. Let both bodies be scaled and posed by the motions of motion/motion: between two
// poses the position is linear in t and the rotation a slerp. If the proof ends in FREE,
// then at no t in [0,1] do the surfaces of the two meshes come within the clearance of each other,
// and no component of one lies within what closed components of the other enclose (a body that is
// said to be open encloses nothing). src/proof/THEOREM.md walks through it. Bodies that at no time
// come as near as their extents and the clearance together need none of this: nsvcd__prove.
//   1. Every point of a surface lies in a piece of some patch (surface/surface). So it is enough
//      to part each patch of one body from each of the other, at all times.
//   2. The broad phase leaves out only patches and segments of time in which the spheres over the
//      pieces stay apart. What it leaves, a pair of patches in one segment, is an *item*. Every
//      item is parted by one of the steps below, or the verdict is not FREE.
//   3. A *span* is a stretch of the motion: a segment or a part of one. In it the true place of a
//      point x of the moving body (body frame) leaves the chord between its places at the ends by
//      no more than nsvcd__deviation along any direction: that is the bulge of motion/segments,
//      taken along a plane's normal (within one arc of angle h of one body it is h^2 / 8 |x|, and
//      nothing along the axis). A plane that has the moving side's places at both ends on one side,
//      by more than that and the clearance, has their chords there too, for a chord is convex, and
//      so all places between.
//   4. Discs: the plane is normal to a patch, or to a group of 16; what each side reaches along it
//      follows from its disc. Hulls: any plane; a patch's pieces are within its slack of the hull
//      of its first vertices. Triangles: a plane for a couple, two listed triangles. A patch lists
//      all triangles of its pieces, whole or in parts.
//   5. Rounding: every plane allows for NSVCD__ROUNDING of all lengths that enter a float
//      computation: that is `rounding`, in spans and segments alike. Stored vertices are off by the
//      patch's slack or quantum, which every plane allows for too. Couples of triangles are parted
//      in double. No NaN comes into it: questions and bodies are checked to be finite and within
//      bounds. Where floats could overflow all the same, in hulls, it is seen to that a NaN parts
//      nothing.
//   6. Containment is decided at t = 0, component by component: a component that is inside of the
//      other body then, and not later, or the other way about, has crossed a surface in between. A
//      component is asked about by one of its vertices, its seed. A ray from the seed counts, with
//      their signs, the triangles of the other body's closed components that it leaves and enters
//      through: the sum is how often these wind about the seed, 0 outside. A ray that passes an
//      edge within the quanta is given up for another; open components enclose nothing. The stored
//      triangles, about which this is, are as far from the true ones as the quanta say: so where a
//      stored triangle is that near to the seed, the answer counts only if planes part all patches
//      at t = 0: then the seed, the stored surface and the true one are, patch by patch, on one
//      side of a plane, and agree.
//
// A witness is a pair of stored triangles that share a point at the true pose, in double, or, where
// a clearance is asked for, come within it; the mesh's own triangles are then within that and the
// two quanta of each other. Faces that are parallel when
// they meet do so at one time only, which rounded numbers miss: there, a corner that is on one side
// of the other triangle at one time and on the other at another, and within its edges all the
// while, has met it between (an edge and an edge likewise), and halving finds when. UNDECIDED: two
// triangles come closer than their quanta and the tolerance without meeting, or the limit of work
// was reached. After such a doubt only a contact can still decide, and flat on flat there are as
// many doubts as triangles: so a share of the limit is all that is left then, more than a yes or no
// takes on any problem of the sets.
//
// FIRST CONTACT. Contacts end the motion: whenever one is found, only what is more than `first`
// before it matters from then on, and is proven free, or gives an earlier contact, or is in doubt.
// Segments are searched some at a time, in their order, so that what is found first is early. Once
// the share that a doubt leaves is spent, the doubt is the end, and what is before it is proven.
// Where no contact is known then, it is asked whether there is any.
//
// THE LEAST DISTANCE. Asked last, when it is known whether they come within the clearance. Contacts
// lower the clearance: it begins as a distance that two vertices have, and whenever triangles are
// found nearer than that, it becomes their distance less `measure`. What has been parted stays
// parted, by more than that. So both are one search whose question shrinks, and in the end all of
// the motion that matters is proven free at the clearance that matters.
//
// Work is counted in units: a plane sought for two hulls, 16 triangles against the box of 16, one
// of them against these, a couple at one time, a ray against 16 triangles or one. Spheres, discs
// and planes that held before are not counted. A query stops within one patch's listings, or one
// ray, of its limit: nsvcd__is_spent.

#ifndef NSVCD_NO_PROOF
// THE SCHEDULE, in the order in which a query comes to it.
// The search hands over items as it finds them.
#define NSVCD__FRESH 48  // room for items on which nothing has been tried
#define NSVCD__NEWS 8    // of them are worth a look before the search goes on
// A look: planes and witnesses, the deepest item first.
#define NSVCD__DEEP 0.2f       // items as deep: a witness is sought before any plane
#define NSVCD__PLANE_STEPS 12  // of Gilbert's iteration, for a plane between two hulls
#define NSVCD__HOPE 8       // looks for a witness in vain, before triangles are tried as well
#define NSVCD__HEIGHTS 256  // over the plane that held last, remembered: of moving patches,
#define NSVCD__REST_HEIGHTS 64  // and of resting ones
// What no plane parts is settled by its triangles, arc by arc.
#define NSVCD__ITEMS 256  // room for such items; when it is full they are settled first
#define NSVCD__WINDOW 8   // blocks of a resting patch, loaded at once
// Parts that couples ask for, before the span is halved for all, if it is longer than this share of
// an arc.
#define NSVCD__PATIENCE_TO_PART 12
#define NSVCD__SHORTEST 0.015
#define NSVCD__ARC_PARTS 8       // of an arc, waiting
#define NSVCD__HALVINGS 40       // of a span for one couple
#define NSVCD__PLACED 8          // poses, remembered
#define NSVCD__SAME_PLACE 1e-13  // of all lengths: a distance in double that is none
#define NSVCD__IN_DOUBT 8  // the share of the limit, 1 / this, that goes on after a doubt
// What else a question asks.
// units: before the ends of the motion are looked at by themselves; for each of these looks; to
// find triangles that meet where one is within the other
#define NSVCD__LONG 6000
#define NSVCD__LOOK 1000
#define NSVCD__GLANCE 200
#define NSVCD__TURNS 2     // from when they are nearest to where, and again: for a first bound
#define NSVCD__FINER 2     // times: from pass to pass, where the least distance is measured
#define NSVCD__IN_ORDER 4  // segments searched together, where the first contact is sought
#define NSVCD__TOUCHES 26  // contacts at the start, looked at together, where there is a skin
#define NSVCD__LIFTS 6     // directions in which they are undone
#define NSVCD__DEEPEN 4    // looks at what is touched on the way off
#define NSVCD__SET_DOWN 0.02  // of the skin: what is kept, where a body is set down
#define NSVCD__HAIRS 3        // both bodies' quanta: so far before a contact a safe place is
#define NSVCD__AROUND 8       // directions along which contact points are sought,
#define NSVCD__SUPPORTS 10    // and two across what these span,
#define NSVCD__SLIM 0.3       // if that is less than this times its length squared; and
#define NSVCD__HOLDS 64       // items that are looked at for them
#define NSVCD__CROSSED 128    // triangles that a ray crosses, where containment is decided
#define NSVCD__NEVER 1e300    // ticks

typedef struct nsvcd__item {
  uint16_t moving, fixed, segment;
  uint16_t sought;  // 1: a witness has been looked for
  // 1 - least distance of the centres / (r1 + r2)
  float depth;
  // of the segment, gone by at that time
  float share;
} nsvcd__item;

// How a body turns over an arc.
typedef struct nsvcd__leg {
  // at its poses before and after: unit, on the shorter side
  nsvcd__dquat start, end;
  double half_angle;  // between them as quaternions: half the angle of the turn
  // where between these poses the arc begins, and how much of the way it lasts
  double from, share;
} nsvcd__leg;

// The motion between two knots, in double and in the fixed body's units.
typedef struct nsvcd__arc {
  // when it begins, and how long it lasts; no ticks: none
  uint32_t first, ticks;
  int fixed_moves;
  // of the moving body
  double scale;
  nsvcd__leg moving;  // as the fixed body sees it; where that moves, in the world, and so is
  nsvcd__leg fixed;   // the fixed body's own
  // from the fixed body's origin to the moving one's, and how it changes; in the same axes
  nsvcd__d3 from, moved;
  // what is added to that as the fixed body sees it
  nsvcd__d3 lift;
  // of the turn, unit, if the fixed body does not turn
  nsvcd__d3 axis;
  int has_axis;
  // over the arc, as the fixed body sees it: radians, and the way of the moving origin, at most
  double turn, speed;
  // what points one metre from the moving body's origin, and that itself, leave their chord by
  double bulge, drift;
} nsvcd__arc;

// A pose in double.
typedef struct nsvcd__placement {
  nsvcd__dmat3 rotation;
  nsvcd__d3 position;
} nsvcd__placement;

// A stretch of the motion. t in [0,1]. In it the true place of a point of the moving body at r
// metres from its origin is off the chord between its places at both ends by no more than drift +
// bulge r, and what float computation of it is off by is no more than `rounding`.
typedef struct nsvcd__span {
  nsvcd__transform start, end;
  double t_start, t_end;
  float rounding, drift, bulge;
  // unit; of the turn from start to end, and of the origin's way
  nsvcd__f3 axis, way;
  // the same along the axis; and drift across the way
  float bulge_along_axis, drift_along_axis, drift_off_way;
} nsvcd__span;

// 16 triangles of a patch, lane by lane: corners (corner, axis, lane), and their boxes.
typedef struct nsvcd__block {
  float corners[3][3][NSVCD__LANES];
  float low[3][NSVCD__LANES], high[3][NSVCD__LANES];
  size_t first, count;  // listings
} nsvcd__block;

typedef struct nsvcd__contact {
  double tick;      // when
  double distance;  // of the triangles
  // the fixed body's frame; out of the fixed body
  nsvcd__d3 point, normal;
  uint32_t moving_triangle, fixed_triangle;
  uint16_t moving_patch, fixed_patch;
} nsvcd__contact;

// Two triangles that touch at the start, as the fixed body sees them.
typedef struct nsvcd__touch {
  nsvcd__d3 moving[3], fixed[3];
  // directions that may undo it, unit: against the normal of the moving one; the normal of the
  // fixed one; and from its nearest point to that of the moving one, 0 if they meet
  nsvcd__d3 ways[3];
} nsvcd__touch;

// Places where the bodies touch when a contact is: proof/manifold.
typedef struct nsvcd__manifold {
  // unit: the contact's, and directions across it
  nsvcd__d3 normal, along[NSVCD__SUPPORTS];
  // nearer than `reach` is touching; nearer to each other than `same` is the same place
  double reach, same;
  // the farthest along each: how far that is, -HUGE_VAL: there is none, HUGE_VAL: it is not
  // sought; and the number of the corner or the edges
  nsvcd__contact supports[NSVCD__SUPPORTS];
  double farthest[NSVCD__SUPPORTS];
  uint32_t numbers[NSVCD__SUPPORTS];
} nsvcd__manifold;

// What is done with triangles that come within the clearance: they are contacts; or, of a motion at
// rest, all are gathered, as touches or as supports.
typedef enum nsvcd__gathering {
  NSVCD__CONTACTS,
  NSVCD__TOUCHING,
  NSVCD__SUPPORTING
} nsvcd__gathering;

// What is said of a question in the end.
typedef enum nsvcd__verdict {
  NSVCD__FREE,
  NSVCD__MEETS,
  NSVCD__WITHIN,
  NSVCD__UNDECIDED
} nsvcd__verdict;

// What becomes of a part of it: a pair of patches, or of triangles, over a stretch of the motion.
typedef enum nsvcd__outcome {
  // parted, or kept as a doubt, or no longer asked about
  NSVCD__SETTLED,
  // where a contact was looked for, there is none
  NSVCD__NOTHING,
  // a contact was found that answers the question
  NSVCD__ANSWERED,
  // a contact was found that shrinks the question: ask again
  NSVCD__SHRUNK,
  // the stretch is to be looked at again: in halves, or with a clearance that is less
  NSVCD__TOO_LONG,
  // the work allowed is: from then on it always is
  NSVCD__SPENT
} nsvcd__outcome;

// A pose that has been computed.
typedef struct nsvcd__placed {
  uint32_t arc, ticks;  // as the arc has them
  double u;
  nsvcd__placement placement;
} nsvcd__placed;

// A patch's height over a plane, of a moving patch in a segment.
typedef struct nsvcd__height {
  uint32_t plane, key;
  float height;
} nsvcd__height;

// The question, in the fixed body's units.
typedef struct nsvcd__given {
  // extents of both bodies
  float lengths;
  // beyond the quanta
  double tolerance;
  double clearance, skin;
  // how far both bodies together go beyond their triangles: the clearance has that in it
  double round;
  // to which share of the motion the first contact is asked for, and to which width the least
  // distance; 0: it is not
  double share, width;
  // FIRST: how far bodies may be from each other when the motion ends; 0: nothing is said
  double to;
  // is more asked for than yes or no?
  int tells;
  // units that may be taken
  size_t work;
} nsvcd__given;

// What is asked at a time, of a motion. A search only ever makes it less: a contact is two
// triangles that come within the clearance. With `measure` each contact makes that the distance of
// its triangles, less this; with `first` each ends the motion so many ticks before it. So what is
// proven in the end holds for the rest.
typedef struct nsvcd__asked {
  nsvcd__motion *motion;
  // ticks: what begins then or later does not matter
  double end;
  // nor does what begins with the first doubt
  int doubts_end;
  double clearance, measure;
  // a share of the motion, and as ticks
  double share, first;
  // units: how many may have been taken, and how many go on after a doubt
  size_t limit, in_doubt;
  // a try: there is a longer one after it
  int is_brief;
  // all of a time before what is later, whatever that costs
  int by_time;
  nsvcd__gathering gathers;
  // how deep touches may be
  double skin;
} nsvcd__asked;

// What is known, of a motion.
typedef struct nsvcd__known {
  int has_contact;
  nsvcd__contact found;
  // ticks: when the first doubt begins, two triangles too near to tell; and these
  double unsure;
  nsvcd__contact doubt;
  // the work allowed was not enough: all from `settled` on, ticks, is undecided
  int lost;
  double settled;
} nsvcd__known;

// What is only remembered: where there is an NSVCD__PAUSE it may be forgotten, and what is proven
// then is as true; only the work may differ. Zeros: nothing.
typedef struct nsvcd__memo {
  // poses in arcs, the next to be forgotten
  nsvcd__placed placed[NSVCD__PLACED];
  size_t next_placed;
  // segments that have been made spans
  uint64_t spans;
  // the normal of the plane between hulls that held last, how many held before, 0: none; and over
  // it the heights of patches, moving ones and resting ones
  nsvcd__f3 held;
  uint32_t plane;
  nsvcd__height heights[NSVCD__HEIGHTS], rest_heights[NSVCD__REST_HEIGHTS];
  // unit: of the plane that parted a couple last
  nsvcd__d3 parting;
  // how many blocks of a resting patch are in p->fixed_blocks; is one in p->moving_block?
  size_t window;
  int has_block;
} nsvcd__memo;

typedef struct nsvcd__proof {
  nsvcd__facets moving, fixed;
  nsvcd__given given;
  nsvcd__asked ask;
  nsvcd__known known;
  nsvcd__memo memo;
  // the last one asked for, if it has ticks; items and couples are looked at within it
  nsvcd__arc arc;
  size_t work;
  // the least distance is known to be between these
  double low, high;

  // Containment, at the start: a component seems to be within the other body, but close to its
  // surface; a point of it, in the fixed body's frame; or that could not be told.
  int within;
  nsvcd__d3 enclosed;
  int unclear;
  // the least distance is not known as narrowly as was asked for
  int wide;
  // FIRST: nothing of the motion is proven free but its start
  int starts_free;

  // With a skin: how many touches have been gathered that a lift along no normal known undoes; the
  // normals, unit, of what the moving body touches, towards it.
  size_t touch_count, normal_count;
  // and one has been found that nothing undoes
  int too_deep;
  nsvcd__d3 normals[NSVCD__LIFTS];
  // how deep it is in contact along each; and by how much a plane normal to one is to be lifted
  double depths[NSVCD__LIFTS];
  double needed;

  // Segments as spans (S), where the memo says so; which have been cut off, and the end, ticks,
  // when that was done last.
  nsvcd__span *spans;
  uint64_t clipped;
  double clipped_end;

  // segments in which 16 resting patches are met
  uint64_t met_in[NSVCD__GROUP];
  // Items: as the search finds them, and those that no plane parts over their segment; and looks
  // for a witness that found none.
  size_t fresh_count, count, misses;
  nsvcd__item fresh[NSVCD__FRESH];
  union {
    struct {
      nsvcd__item items[NSVCD__ITEMS];
      nsvcd__manifold manifold;
    } kept;
    // gathered before there are any
    nsvcd__touch touches[NSVCD__TOUCHES];
  } of;

  // An item: its hulls, posed, and its triangles, block by block, with boxes about the fixed
  // blocks; corners of the moving block at the ends of a span.
  float hull_start[3][NSVCD__LANES], hull_end[3][NSVCD__LANES], hull_rest[3][NSVCD__LANES];
  nsvcd__block moving_block, fixed_blocks[NSVCD__WINDOW];
  nsvcd__box bounds[NSVCD__WINDOW];
  float posed[2][3][3][NSVCD__LANES];

  // An item over an arc, and a couple: later ends of the parts to come, the last one first; and how
  // many parts of the span its couples asked for.
  nsvcd__span span;
  double arc_ends[NSVCD__ARC_PARTS];
  double couple_ends[NSVCD__HALVINGS + 2];
  size_t parts;

  // triangles that a ray has crossed
  uint32_t crossed[NSVCD__CROSSED];
} nsvcd__proof;

// Forgets all that is only remembered. The tests do so at random, where NSVCD__PAUSE stands.
static void nsvcd__forget(nsvcd__memo *memo) {
  for (size_t n = 0; n < NSVCD__PLACED; n++) memo->placed[n].ticks = 0;
  memo->next_placed = 0;
  memo->spans = 0;
  memo->held = nsvcd__f3_of(0, 0, 0);
  memo->plane = 0;
  memo->parting = nsvcd__d3_of(0, 0, 0);
  memo->window = 0;
  memo->has_block = 0;
}
#ifndef NSVCD__PAUSE
#define NSVCD__PAUSE(p) ((void)0)
#endif

// A limit that leaves so many units, if there are as many.
static size_t nsvcd__limit_after(const nsvcd__proof *p, size_t units) {
  const size_t left = p->work < p->given.work ? p->given.work - p->work : 0;
  return left > units ? p->work + units : p->given.work;
}

// What the search for the first contact may take. The rest is for the question whether there is
// any.
static size_t nsvcd__limit_of_first(const nsvcd__proof *p) {
  return p->given.work - p->given.work / NSVCD__IN_DOUBT;
}

// Is all work done that is allowed? Where the first contact is sought, what a doubt has left for
// contacts after it may be: then the doubt becomes the end here, and what comes before it can be
// proven.
static int nsvcd__is_spent(nsvcd__proof *p) {
  nsvcd__asked *ask = &p->ask;
  if (p->work > ask->limit && ask->first > 0 && !ask->is_brief && !ask->doubts_end &&
      p->known.unsure < NSVCD__NEVER) {
    ask->doubts_end = 1;
    ask->end = nsvcd__min(ask->end, p->known.unsure);
    ask->limit = nsvcd__limit_of_first(p);
  }
  return p->work > ask->limit;
}

// The clearance, in float: not less.
static float nsvcd__clearance(const nsvcd__proof *p) {
  return 1.000001f * (float)p->ask.clearance;
}

// What stored triangles of two patches may be off by, both together.
static float nsvcd__quanta_of(const nsvcd__proof *p, size_t i, size_t j) {
  return p->ask.motion->scale * p->moving.quanta[i] + p->fixed.quanta[j];
}

// No point of the patch's pieces is farther from the body's origin; in the body's own units, as
// bulges have it.
static float nsvcd__patch_reach(const nsvcd__facets *f, size_t patch) {
  const float distance = nsvcd__f3_length(nsvcd__facet_centre(f, patch));
  return 1.000001f * (distance + nsvcd__body_r(f->body)[patch]);
}

// Tests hear of every plane of discs, hulls and triangles (spheres and boxes have tests of their
// own): kind, patches, listings (or NSVCD_NONE), times, and the plane's normal (3), fixed body's
// frame, which points to the moving side.
#ifndef NSVCD__CERTIFY
#define NSVCD__CERTIFY(kind, moving, fixed, moving_listing, fixed_listing, t_start, t_end, \
                       normal) \
  ((void)0)
#endif
enum { NSVCD__BY_DISC, NSVCD__BY_HULL, NSVCD__BY_TRIANGLES };
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/poses
// In: a motion, an arc of it and a share of that. Out: where the moving body is, in double, to the
// last digits.

#ifndef NSVCD_NO_PROOF
static nsvcd__dquat nsvcd__unit_rotation(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dquat out = {(double)q[0], (double)q[1], (double)q[2], (double)q[3]};
  return nsvcd__dquat_unit(out);
}

static nsvcd__d3 nsvcd__place_point(const nsvcd__placement *at, nsvcd__d3 a) {
  return nsvcd__d3_add(nsvcd__dmat3_apply(&at->rotation, a), at->position);
}

// The rotation a share u in [0,1] of the arc later than its start; unit.
static nsvcd__dquat nsvcd__leg_at(const nsvcd__leg *leg, double u) {
  const double way = leg->from + leg->share * u;
  double before = 1 - way;
  double after = way;
  // below, the difference is less than rounding
  if (leg->half_angle > 1e-7) {
    before = nsvcd__sin((1 - way) * leg->half_angle);
    after = nsvcd__sin(way * leg->half_angle);
  }
  const nsvcd__dquat start = nsvcd__dquat_scale(leg->start, before);
  return nsvcd__dquat_unit(nsvcd__dquat_fma(after, leg->end, start));
}

// A track's leg of an arc, and its positions at both ends of it, metres.
static void nsvcd__leg_init(const nsvcd__track *track, uint32_t first, uint32_t ticks,
                            nsvcd__leg *leg, nsvcd__d3 *ends) {
  if (track->count == 1) {
    leg->start = nsvcd__unit_rotation(track->poses);
    leg->end = leg->start;
    leg->half_angle = 0;
    leg->from = 0;
    leg->share = 1;
    ends[0] = nsvcd__d3_load(track->poses->position);
    ends[1] = ends[0];
    return;
  }
  const uint32_t k = nsvcd__pose_before(track, first);
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = a + 1;
  const uint32_t begin = nsvcd__tick_of(track, k);
  const double per_tick = 1 / (double)(nsvcd__tick_of(track, k + 1) - begin);
  leg->share = (double)ticks * per_tick;
  leg->from = (double)(first - begin) * per_tick;
  const nsvcd__d3 start = nsvcd__d3_load(a->position);
  const nsvcd__d3 way = nsvcd__d3_sub(nsvcd__d3_load(b->position), start);
  ends[0] = nsvcd__d3_add(start, nsvcd__d3_scale(way, leg->from));
  ends[1] = nsvcd__d3_add(start, nsvcd__d3_scale(way, leg->from + leg->share));

  const double sign = nsvcd__poses_opposed(a, b) ? -1 : 1;
  leg->start = nsvcd__unit_rotation(a);
  leg->end = nsvcd__dquat_scale(nsvcd__unit_rotation(b), sign);
  const nsvcd__dquat difference = nsvcd__dquat_fma(-1, leg->end, leg->start);
  const double apart = nsvcd__dquat_dot(difference, difference);
  const nsvcd__dquat sum = nsvcd__dquat_fma(1, leg->end, leg->start);
  const double together = nsvcd__dquat_dot(sum, sum);
  leg->half_angle = 2 * nsvcd__atan2(sqrt(apart), sqrt(together));
}

// The rotation vector of a leg, over its arc.
static nsvcd__d3 nsvcd__leg_turn(const nsvcd__leg *leg) {
  const nsvcd__d3 u = nsvcd__dquat_axis(leg->start);
  const nsvcd__d3 v = nsvcd__dquat_axis(leg->end);
  const nsvcd__d3 ahead = nsvcd__d3_scale(v, leg->start.w);
  const nsvcd__d3 difference = nsvcd__d3_sub(ahead, nsvcd__d3_scale(u, leg->end.w));
  const nsvcd__d3 across = nsvcd__d3_add(difference, nsvcd__d3_cross(u, v));
  const double sine = nsvcd__d3_length(across);
  return nsvcd__d3_scale(across, sine > 0 ? 2 * leg->half_angle * leg->share / sine : 0);
}

// The arc that begins at the knot `first`.
static const nsvcd__arc *nsvcd__arc_at(nsvcd__proof *p, uint32_t first) {
  const nsvcd__motion *motion = p->ask.motion;
  nsvcd__arc *arc = &p->arc;
  const uint32_t ticks = nsvcd__next_knot(motion, first) - first;
  if (arc->first == first && arc->ticks == ticks) return arc;
  nsvcd__d3 ends[2], fixed_ends[2];
  const double per_metre = 1 / (double)motion->unit;
  arc->first = first;
  arc->ticks = ticks;
  arc->fixed_moves = motion->fixed_moves;
  arc->scale = (double)motion->scale;
  arc->lift = nsvcd__d3_widen(motion->lift);
  nsvcd__leg_init(&motion->moving, first, ticks, &arc->moving, ends);
  nsvcd__leg_init(&motion->fixed, first, ticks, &arc->fixed, fixed_ends);
  const nsvcd__d3 from = nsvcd__d3_sub(ends[0], fixed_ends[0]);
  const nsvcd__d3 to = nsvcd__d3_sub(ends[1], fixed_ends[1]);
  arc->from = nsvcd__d3_scale(from, per_metre);
  arc->moved = nsvcd__d3_scale(nsvcd__d3_sub(to, from), per_metre);
  const nsvcd__dmat3 fixed = nsvcd__dmat3_of(arc->fixed.start);
  if (arc->fixed_moves) {
    // what both bodies' turns do: see nsvcd__cut_double_arc
    const nsvcd__d3 fixed_turn = nsvcd__leg_turn(&arc->fixed);
    const nsvcd__d3 turn = nsvcd__d3_sub(nsvcd__leg_turn(&arc->moving), fixed_turn);
    const nsvcd__d3 end = nsvcd__d3_add(arc->from, arc->moved);
    const double twist = nsvcd__d3_length(nsvcd__d3_cross(turn, fixed_turn));
    const double angle = nsvcd__d3_length(fixed_turn);
    const double swing_from = nsvcd__d3_length(nsvcd__d3_cross(fixed_turn, arc->from));
    const double swing_to = nsvcd__d3_length(nsvcd__d3_cross(fixed_turn, end));
    const double swing = nsvcd__max(swing_from, swing_to);
    const double across = nsvcd__d3_length(nsvcd__d3_cross(fixed_turn, arc->moved));
    arc->has_axis = !(angle > 0);
    arc->turn = nsvcd__d3_length(turn);
    arc->speed = nsvcd__d3_length(arc->moved) + swing;
    arc->bulge = 0.1250001 * arc->scale * (arc->turn * arc->turn + twist);
    arc->drift = 0.1250001 * (2 * across + angle * swing);
    arc->axis = nsvcd__d3_unit(turn, nsvcd__d3_of(1, 0, 0));
    // where the fixed body only goes along, its axes are those of its start
    if (arc->has_axis) arc->axis = nsvcd__dmat3_apply_transpose(&fixed, arc->axis);
    return arc;
  }

  arc->moving.start = nsvcd__dquat_inverse_mul(arc->fixed.start, arc->moving.start);
  arc->moving.end = nsvcd__dquat_inverse_mul(arc->fixed.start, arc->moving.end);
  arc->from = nsvcd__dmat3_apply_transpose(&fixed, arc->from);
  arc->moved = nsvcd__dmat3_apply_transpose(&fixed, arc->moved);
  const nsvcd__d3 turn = nsvcd__leg_turn(&arc->moving);
  arc->has_axis = 1;
  arc->axis = nsvcd__d3_unit(turn, nsvcd__d3_of(1, 0, 0));
  arc->turn = 2 * arc->moving.half_angle * arc->moving.share;
  arc->speed = nsvcd__d3_length(arc->moved);
  arc->bulge = 0.1250001 * arc->scale * arc->turn * arc->turn;
  arc->drift = 0;
  return arc;
}

// Do all points of the moving body go along straight lines, seen from the fixed one?
static int nsvcd__is_straight(const nsvcd__arc *arc) {
  return !(arc->bulge > 0 || arc->drift > 0);
}

// The true pose, seen from the fixed body, a share u in [0,1] of the arc later than its start. Its
// rotation is times the moving body's scale.
static nsvcd__placement nsvcd__placement_at(const nsvcd__arc *arc, double u) {
  nsvcd__dquat q = nsvcd__leg_at(&arc->moving, u);
  nsvcd__placement at;
  at.position = nsvcd__d3_add(arc->from, nsvcd__d3_scale(arc->moved, u));
  if (arc->fixed_moves) {
    const nsvcd__dquat fixed = nsvcd__leg_at(&arc->fixed, u);
    const nsvcd__dmat3 matrix = nsvcd__dmat3_of(fixed);
    q = nsvcd__dquat_inverse_mul(fixed, q);
    at.position = nsvcd__dmat3_apply_transpose(&matrix, at.position);
  }
  const nsvcd__dmat3 rotation = nsvcd__dmat3_of(q);
  at.rotation = nsvcd__dmat3_scale(&rotation, arc->scale);
  at.position = nsvcd__d3_add(at.position, arc->lift);
  return at;
}

// The same, of p->arc, remembered: couples ask for the same poses again.
// The last two that were asked for stay where they are.
static const nsvcd__placement *nsvcd__placed_at(nsvcd__proof *p, double u) {
  size_t n = 0;
  const nsvcd__arc *arc = &p->arc;
  for (; n < NSVCD__PLACED; n++) {
    const nsvcd__placed *known = &p->memo.placed[n];
    if (known->arc == arc->first && known->ticks == arc->ticks && known->u == u) break;
  }
  if (n == NSVCD__PLACED) {
    n = p->memo.next_placed;
    p->memo.placed[n].arc = arc->first;
    p->memo.placed[n].ticks = arc->ticks;
    p->memo.placed[n].u = u;
    p->memo.placed[n].placement = nsvcd__placement_at(arc, u);
  }
  if (n == p->memo.next_placed) p->memo.next_placed = (n + 1) % NSVCD__PLACED;
  return &p->memo.placed[n].placement;
}

static nsvcd__transform nsvcd__transform_of(const nsvcd__placement *at) {
  nsvcd__transform out;
  out.rotation.x = nsvcd__d3_narrow(at->rotation.x);
  out.rotation.y = nsvcd__d3_narrow(at->rotation.y);
  out.rotation.z = nsvcd__d3_narrow(at->rotation.z);
  out.position = nsvcd__f3_round(at->position);
  return out;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/spans
// In: a segment, or an arc and two shares of it. Out: a span: the poses at both ends, and by how
// much a point may leave the chord in between.

#ifndef NSVCD_NO_PROOF
// The time at which so many ticks have gone by.
static double nsvcd__time_of(const nsvcd__motion *motion, double ticks) {
  return motion->begin + motion->duration * ticks / (double)motion->ticks;
}

// The time a share u of the arc last asked for later than its start.
static double nsvcd__time_in_arc(const nsvcd__proof *p, double u) {
  return nsvcd__time_of(p->ask.motion, (double)p->arc.first + u * (double)p->arc.ticks);
}

static nsvcd__span nsvcd__span_of_segment(const nsvcd__motion *motion,
                                          const nsvcd__search *search, size_t s) {
  nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, l);
  nsvcd__span span;
  span.start.rotation = nsvcd__mat3_lane(block->rotation, l);
  span.end.rotation = nsvcd__mat3_mix(1, &span.start.rotation, 1, &turned);
  span.start.position = nsvcd__lane_of(block->position, l);
  span.end.position = nsvcd__f3_add(span.start.position, nsvcd__lane_of(block->moved, l));
  span.bulge = block->bulge[l];
  span.rounding = block->rounding[l];
  span.drift = block->drift[l];
  span.axis = nsvcd__lane_of(block->axis, l);
  span.way = nsvcd__lane_of(block->way, l);
  span.bulge_along_axis = block->bulge_along_axis[l];
  span.drift_along_axis = block->drift_along_axis[l];
  span.drift_off_way = block->drift_off_way[l];
  span.t_start = nsvcd__time_of(motion, (double)search->begin[s]);
  span.t_end = nsvcd__time_of(motion, (double)search->begin[s + 1]);
  return span;
}

// Kept once it has been made.
static const nsvcd__span *nsvcd__segment_span(nsvcd__proof *p, const nsvcd__search *search,
                                              size_t s) {
  if (!(p->memo.spans >> s & 1)) {
    p->spans[s] = nsvcd__span_of_segment(p->ask.motion, search, s);
    p->spans[s].t_end =
        nsvcd__min(p->spans[s].t_end, nsvcd__time_of(p->ask.motion, p->ask.end));
  }
  p->memo.spans |= (uint64_t)1 << s;
  return &p->spans[s];
}

// The span from u0 to u1 of the arc that begins at the knot `first`.
static nsvcd__span nsvcd__span_of_arc(nsvcd__proof *p, uint32_t first, double u0, double u1) {
  const nsvcd__arc *arc = nsvcd__arc_at(p, first);
  const nsvcd__placement start = nsvcd__placement_at(arc, u0);
  const nsvcd__placement end = nsvcd__placement_at(arc, u1);
  const double square = (u1 - u0) * (u1 - u0);
  nsvcd__span span;
  span.start = nsvcd__transform_of(&start);
  span.end = nsvcd__transform_of(&end);
  const float remote_start = nsvcd__f3_length(span.start.position);
  const float remote = remote_start + nsvcd__f3_length(span.end.position);
  span.bulge = (float)(square * arc->bulge);
  span.drift = (float)(square * arc->drift * 1.000001);
  span.rounding = NSVCD__ROUNDING * (remote + p->given.lengths);
  span.drift_along_axis = span.drift_off_way = span.drift;
  span.axis = nsvcd__f3_round(arc->axis);
  span.way = span.axis;  // any
  span.bulge_along_axis = arc->has_axis ? 1e-6f * span.bulge : span.bulge;
  span.t_start = nsvcd__time_in_arc(p, u0);
  span.t_end = nsvcd__time_in_arc(p, u1);
  return span;
}

// What the points of the moving body, none farther than `reach` from its origin, leave their chords
// by along a direction n, times its length, but for rounding (which is times |n| too). With D the
// difference between the true rotation and the chord's at some time, and d that of the positions, a
// point x is off by n.(D x + d). Split n into its parts along the axis and across it: then
//   |n.D x| <= (|n.axis| |D^T axis| + |n x axis| |D|) |x|
// and |n.d| is bounded in the same way, or with the way of the origin in place of the axis.
static float nsvcd__deviation(const nsvcd__span *span, nsvcd__f3 n, float reach) {
  const float along = fabsf(nsvcd__f3_dot(n, span->axis));
  const float across = nsvcd__f3_length(nsvcd__f3_cross(n, span->axis));
  const float along_way = fabsf(nsvcd__f3_dot(n, span->way));
  const float across_way = nsvcd__f3_length(nsvcd__f3_cross(n, span->way));
  const float by_axis = along * span->drift_along_axis + across * span->drift;
  const float by_way = along_way * span->drift + across_way * span->drift_off_way;
  const float drift = by_axis < by_way ? by_axis : by_way;
  return drift + reach * (along * span->bulge_along_axis + across * span->bulge);
}

// The same for a slice of directions, or one direction in a slice of spans.
typedef struct nsvcd__v_span {
  nsvcd__v3 axis, way;
  nsvcd__v rounding, drift, bulge, bulge_along_axis, drift_along_axis, drift_off_way;
} nsvcd__v_span;

NSVCD__INLINE nsvcd__v_span nsvcd__v_span_set(const nsvcd__span *span) {
  nsvcd__v_span out;
  out.axis = nsvcd__v3_set(span->axis);
  out.way = nsvcd__v3_set(span->way);
  out.rounding = nsvcd__v_set(span->rounding);
  out.drift = nsvcd__v_set(span->drift);
  out.bulge = nsvcd__v_set(span->bulge);
  out.bulge_along_axis = nsvcd__v_set(span->bulge_along_axis);
  out.drift_along_axis = nsvcd__v_set(span->drift_along_axis);
  out.drift_off_way = nsvcd__v_set(span->drift_off_way);
  return out;
}
// Lanes l and on of a block.
NSVCD__INLINE nsvcd__v_span nsvcd__v_span_load(const nsvcd__segments *block, size_t l) {
  nsvcd__v_span out;
  out.axis = nsvcd__v3_rows(block->axis[0] + l);
  out.way = nsvcd__v3_rows(block->way[0] + l);
  out.rounding = nsvcd__v_load(block->rounding + l);
  out.drift = nsvcd__v_load(block->drift + l);
  out.bulge = nsvcd__v_load(block->bulge + l);
  out.bulge_along_axis = nsvcd__v_load(block->bulge_along_axis + l);
  out.drift_along_axis = nsvcd__v_load(block->drift_along_axis + l);
  out.drift_off_way = nsvcd__v_load(block->drift_off_way + l);
  return out;
}
NSVCD__INLINE nsvcd__v nsvcd__v_deviation(const nsvcd__v_span *span, nsvcd__v3 n,
                                          float reach) {
  const nsvcd__v along = nsvcd__v_abs(nsvcd__v3_dot(n, span->axis));
  const nsvcd__v across = nsvcd__v3_length(nsvcd__v3_cross(n, span->axis));
  const nsvcd__v along_way = nsvcd__v_abs(nsvcd__v3_dot(n, span->way));
  const nsvcd__v across_way = nsvcd__v3_length(nsvcd__v3_cross(n, span->way));
  nsvcd__v by_axis = nsvcd__v_mul(across, span->drift);
  by_axis = nsvcd__v_fma(along, span->drift_along_axis, by_axis);
  nsvcd__v by_way = nsvcd__v_mul(across_way, span->drift_off_way);
  by_way = nsvcd__v_fma(along_way, span->drift, by_way);
  nsvcd__v turn = nsvcd__v_mul(across, span->bulge);
  turn = nsvcd__v_fma(along, span->bulge_along_axis, turn);
  return nsvcd__v_fma(turn, nsvcd__v_set(reach), nsvcd__v_min(by_axis, by_way));
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/discs
// In: items, a slice at a time. Out: those that a plane along a disc's normal does not part.

#ifndef NSVCD_NO_PROOF
// A slice of discs.
typedef struct nsvcd__v_disc {
  nsvcd__v3 normal;
  nsvcd__v low, high, across;
} nsvcd__v_disc;

NSVCD__INLINE nsvcd__v_disc nsvcd__v_disc_set(const nsvcd__disc *disc) {
  nsvcd__v_disc out;
  out.normal = nsvcd__v3_set(disc->normal);
  out.low = nsvcd__v_set(disc->low);
  out.high = nsvcd__v_set(disc->high);
  out.across = nsvcd__v_set(disc->across);
  return out;
}
// From (6, stride).
NSVCD__INLINE nsvcd__v_disc nsvcd__v_disc_load(const float *discs, size_t stride) {
  nsvcd__v_disc out;
  out.normal = nsvcd__v3_load_rows(discs, stride);
  out.low = nsvcd__v_load(discs + 3 * stride);
  out.high = nsvcd__v_load(discs + 4 * stride);
  out.across = nsvcd__v_load(discs + 5 * stride);
  return out;
}

// What is reached along a direction.
typedef struct nsvcd__v_range {
  nsvcd__v low, high;
} nsvcd__v_range;

// By discs, from their centres, along directions whose parts along the discs' normals are `along`,
// and whose lengths across these are `across`.
NSVCD__INLINE nsvcd__v_range nsvcd__v_disc_along(const nsvcd__v_disc *disc, nsvcd__v along,
                                                 nsvcd__v across) {
  const nsvcd__v a = nsvcd__v_mul(disc->low, along);
  const nsvcd__v b = nsvcd__v_mul(disc->high, along);
  const nsvcd__v side = nsvcd__v_mul(disc->across, across);
  nsvcd__v_range out;
  out.low = nsvcd__v_sub(nsvcd__v_min(a, b), side);
  out.high = nsvcd__v_add(nsvcd__v_max(a, b), side);
  return out;
}

// By discs along directions in their own frame.
NSVCD__INLINE nsvcd__v_range nsvcd__v_disc_range(const nsvcd__v_disc *disc,
                                                 nsvcd__v3 direction) {
  const nsvcd__v along = nsvcd__v3_dot(direction, disc->normal);
  const nsvcd__v across = nsvcd__v3_length(nsvcd__v3_cross(direction, disc->normal));
  return nsvcd__v_disc_along(disc, along, across);
}

// Moving discs that approach resting ones over a span; either of them, and the span, may be one in
// all lanes.
typedef struct nsvcd__v_approach {
  // in its body's frame and units
  nsvcd__v_disc moving;
  nsvcd__v_disc fixed;
  // from the resting centre to the moving one, and its way
  nsvcd__v3 from, chord;
  // the resting disc's normal in the moving body's frame, at both ends
  nsvcd__v3 at_start, at_end;
  // the mean of the moving disc's normals at both ends, and half of what they differ by
  nsvcd__v3 mean, turned;
  // of the moving body
  nsvcd__v scale;
  nsvcd__v_span span;
  float clearance;
  // no point of the moving side is farther from its body's origin, in its body's units
  float reach;
  // nsvcd__v_off, of the fixed disc's normal
  nsvcd__v fixed_off;
} nsvcd__v_approach;

// Lanes in which planes part two bodies: the moving side is below, or above.
typedef struct nsvcd__v_parted {
  nsvcd__v3 plane;  // its normal
  uint32_t below, above;
} nsvcd__v_parted;

// Along a plane's normal: what a moving point may be off by, and the clearance.
NSVCD__INLINE nsvcd__v nsvcd__v_off(const nsvcd__v_approach *a, nsvcd__v3 plane) {
  const nsvcd__v allowed = nsvcd__v_plus(a->span.rounding, a->clearance);
  return nsvcd__v_add(allowed, nsvcd__v_deviation(&a->span, plane, a->reach));
}

NSVCD__INLINE nsvcd__v_parted nsvcd__v_part(nsvcd__v3 plane, nsvcd__v_range moving,
                                            nsvcd__v_range fixed, nsvcd__v off) {
  nsvcd__v_parted out;
  out.plane = plane;
  out.below = nsvcd__v_lt(moving.high, nsvcd__v_sub(fixed.low, off));
  out.above = nsvcd__v_lt(nsvcd__v_add(fixed.high, off), moving.low);
  return out;
}

// By planes normal to the resting discs.
NSVCD__INLINE nsvcd__v_parted nsvcd__v_part_by_fixed(const nsvcd__v_approach *a) {
  const nsvcd__v3 plane = a->fixed.normal;
  const nsvcd__v_range fixed = {a->fixed.low, a->fixed.high};
  const nsvcd__v_range start = nsvcd__v_disc_range(&a->moving, a->at_start);
  const nsvcd__v_range end = nsvcd__v_disc_range(&a->moving, a->at_end);
  const nsvcd__v height = nsvcd__v3_dot(plane, a->from);
  const nsvcd__v height_end = nsvcd__v_add(height, nsvcd__v3_dot(plane, a->chord));
  nsvcd__v_range moving;
  moving.low =
      nsvcd__v_min(nsvcd__v_add(height, start.low), nsvcd__v_add(height_end, end.low));
  moving.high =
      nsvcd__v_max(nsvcd__v_add(height, start.high), nsvcd__v_add(height_end, end.high));
  return nsvcd__v_part(plane, moving, fixed, a->fixed_off);
}

// By planes normal to the mean w of the moving discs' normals. |w| <= 1. Both normals make the same
// angle with w: along it they are |w|^2, across it no more than |turned|.
NSVCD__INLINE nsvcd__v_parted nsvcd__v_part_by_moving(const nsvcd__v_approach *a) {
  const nsvcd__v3 w = a->mean;
  const nsvcd__v along = nsvcd__v_mul(a->scale, nsvcd__v3_dot(w, w));
  const nsvcd__v across = nsvcd__v_mul(a->scale, nsvcd__v3_length(a->turned));
  const nsvcd__v_range own = nsvcd__v_disc_along(&a->moving, along, across);
  const nsvcd__v height = nsvcd__v3_dot(w, a->from);
  const nsvcd__v height_end = nsvcd__v_add(height, nsvcd__v3_dot(w, a->chord));
  nsvcd__v_range moving;
  moving.low = nsvcd__v_add(nsvcd__v_min(height, height_end), own.low);
  moving.high = nsvcd__v_add(nsvcd__v_max(height, height_end), own.high);
  return nsvcd__v_part(w, moving, nsvcd__v_disc_range(&a->fixed, w), nsvcd__v_off(a, w));
}

#ifdef NSVCD__CERTIFIES
// Patches i and j, by the plane in lane l of a slice.
static void nsvcd__certify_disc(size_t i, size_t j, const nsvcd__v_parted *parted, size_t l,
                                const nsvcd__span *span) {
  float lanes[3][NSVCD__LANES];
  float normal[3];
  nsvcd__v3_store(lanes, 0, parted->plane);
  const float sign = parted->below >> l & 1 ? -1.0f : 1.0f;
  nsvcd__f3_store(nsvcd__f3_scale(nsvcd__lane_of(lanes, l), sign), normal);
  NSVCD__CERTIFY(NSVCD__BY_DISC, i, j, NSVCD_NONE, NSVCD_NONE, span->t_start, span->t_end,
                 normal);
}
// All pairs of members of groups g and h, in the segments `apart` of a slice that begins with
// segment `first`.
static void nsvcd__certify_groups(const nsvcd__proof *p, const nsvcd__search *search, size_t g,
                                  size_t h, size_t first, uint32_t apart,
                                  const nsvcd__v_parted *by_fixed,
                                  const nsvcd__v_parted *by_moving) {
  for (; apart; apart &= apart - 1) {
    const size_t l = nsvcd__low_bit(apart);
    const nsvcd__span span = nsvcd__span_of_segment(p->ask.motion, search, first + l);
    const int is_fixed = (by_fixed->below | by_fixed->above) >> l & 1;
    for (size_t k = 0; k < NSVCD__GROUP * NSVCD__GROUP; k++) {
      const size_t i = NSVCD__GROUP * g + k / NSVCD__GROUP;
      const size_t j = NSVCD__GROUP * h + k % NSVCD__GROUP;
      if (i < p->moving.body->patches && j < p->fixed.body->patches)
        nsvcd__certify_disc(i, j, is_fixed ? by_fixed : by_moving, l, &span);
    }
  }
}
#define NSVCD__CERTIFY_DISC(i, j, parted, l, span) nsvcd__certify_disc(i, j, parted, l, span)
#define NSVCD__CERTIFY_GROUPS(p, search, g, h, first, apart, by_fixed, by_moving) \
  nsvcd__certify_groups(p, search, g, h, first, apart, by_fixed, by_moving)
#else
#define NSVCD__CERTIFY_DISC(i, j, parted, l, span) \
  ((void)(i), (void)(j), (void)(parted), (void)(l), (void)(span))
#define NSVCD__CERTIFY_GROUPS(p, search, g, h, first, apart, by_fixed, by_moving) ((void)0)
#endif

// The lanes of a slice among 16.
static inline uint32_t nsvcd__lanes_of_slice(uint32_t lanes, size_t l) {
  return lanes >> l & (((uint32_t)1 << NSVCD__SLICE) - 1);
}

// Lanes of `wanted` that are not parted: pairs of moving patches from the i-th on and patch j.
static inline uint32_t nsvcd__not_parted(size_t i, size_t j, const nsvcd__span *span,
                                         const nsvcd__v_parted *parted, uint32_t wanted) {
  const uint32_t apart = (parted->above | parted->below) & wanted;
  for (uint32_t k = apart; k; k &= k - 1) {
    const size_t l = nsvcd__low_bit(k);
    NSVCD__CERTIFY_DISC(i + l, j, parted, l, span);
  }
  return wanted & ~apart;
}

// Of the lanes `met` of moving group g in a segment, those that discs do not part from resting
// patch j. c: the chords of the group's patches; reach: no point of the group is farther from the
// body's origin.
static uint32_t nsvcd__discs_meet(const nsvcd__proof *p, const nsvcd__chords *c, size_t g,
                                  size_t j, const nsvcd__span *span, float reach,
                                  uint32_t met) {
  const nsvcd__disc fixed = nsvcd__disc_at(p->fixed.discs, p->fixed.body->padded, j);
  const nsvcd__f3 centre = nsvcd__facet_centre(&p->fixed, j);
  const nsvcd__mat3 *from = &span->start.rotation;
  const nsvcd__mat3 *to = &span->end.rotation;
  uint32_t left = 0;
  nsvcd__v_approach a;
  a.fixed = nsvcd__v_disc_set(&fixed);
  a.at_start = nsvcd__v3_set(nsvcd__mat3_apply_transpose(from, fixed.normal));
  a.at_end = nsvcd__v3_set(nsvcd__mat3_apply_transpose(to, fixed.normal));
  a.scale = nsvcd__v_set(p->ask.motion->scale);
  a.span = nsvcd__v_span_set(span);
  a.clearance = nsvcd__clearance(p);
  a.reach = reach;
  a.fixed_off = nsvcd__v_off(&a, a.fixed.normal);
  NSVCD__EACH_SLICE(l) {
    const size_t i = NSVCD__GROUP * g + l;
    uint32_t wanted = nsvcd__lanes_of_slice(met, l);
    if (!wanted) continue;
    a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
    a.chord = nsvcd__chords_way(c, l);
    a.moving = nsvcd__v_disc_load(p->moving.discs + i, p->moving.body->padded);
    nsvcd__v_parted parted = nsvcd__v_part_by_fixed(&a);
    wanted = nsvcd__not_parted(i, j, span, &parted, wanted);
    if (!wanted) continue;
    // rotations in a span are times the scale
    const float half = 0.5f * p->ask.motion->per_scale;
    const nsvcd__mat3 middle = nsvcd__mat3_mix(half, to, 1, from);
    const nsvcd__mat3 half_turn = nsvcd__mat3_mix(half, to, -1, from);
    a.mean = nsvcd__vmat3_apply(nsvcd__vmat3_set(&middle), a.moving.normal);
    a.turned = nsvcd__vmat3_apply(nsvcd__vmat3_set(&half_turn), a.moving.normal);
    parted = nsvcd__v_part_by_moving(&a);
    left |= nsvcd__not_parted(i, j, span, &parted, wanted) << l;
  }
  return left;
}

// Clears the segments in which discs part the moving group that is searched, whose chords are in
// search->group, from the resting ones that it meets: 16 segments at a time. The planes are those
// of single discs, with all in lanes but the discs.
static NSVCD__APART void nsvcd__part_groups(const nsvcd__proof *p, nsvcd__search *search) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const size_t next = search->order[search->step];
  const size_t g = search->moving_tile.groups[next];
  const nsvcd__disc own =
      nsvcd__disc_at(p->moving.group_discs, nsvcd__group_slots(moving->padded), g);
  nsvcd__v_approach a;
  a.moving = nsvcd__v_disc_set(&own);
  a.scale = nsvcd__v_set(search->scale);
  a.clearance = nsvcd__clearance(p);
  a.reach = nsvcd__group_reach(moving, g);
  for (uint32_t waiting = search->waiting; waiting; waiting &= waiting - 1) {
    const size_t at = nsvcd__low_bit(waiting);
    const size_t h = search->fixed_tile.groups[at];
    const nsvcd__disc other =
        nsvcd__disc_at(p->fixed.group_discs, nsvcd__group_slots(fixed->padded), h);
    const nsvcd__f3 centre = nsvcd__centre_of(nsvcd__groups_of(fixed), h);
    uint64_t *met = &nsvcd__nearby(search, next)[at];
    a.fixed = nsvcd__v_disc_set(&other);
    for (size_t first = 0; first < NSVCD__MAX_SEGMENTS; first += NSVCD__SLICE) {
      const uint32_t wanted = nsvcd__lanes_of_slice((uint32_t)(*met >> first & 0xffff), 0);
      nsvcd__segments *block = &search->blocks[first / NSVCD__LANES];
      const nsvcd__chords *c = &search->group[first / NSVCD__LANES];
      const size_t l = first % NSVCD__LANES;
      if (l == 0 && (*met >> first & 0xffff)) NSVCD__TALLY(tests, 1);
      if (!wanted) continue;
      const nsvcd__vmat3 rotation = nsvcd__vmat3_load(block->rotation, l);
      const nsvcd__vmat3 turn = nsvcd__vmat3_load(block->turned, l);
      const nsvcd__v half = nsvcd__v_set(0.5f / search->scale);
      const nsvcd__v whole = nsvcd__v_set(1 / search->scale);
      const nsvcd__v3 n = a.fixed.normal;
      const nsvcd__v3 m = a.moving.normal;
      a.span = nsvcd__v_span_load(block, l);
      a.fixed_off = nsvcd__v_off(&a, n);
      a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
      a.chord = nsvcd__chords_way(c, l);
      a.at_start = nsvcd__vmat3_apply_transpose(rotation, n);
      a.at_end = nsvcd__v3_add(a.at_start, nsvcd__vmat3_apply_transpose(turn, n));
      a.turned = nsvcd__v3_scale(nsvcd__vmat3_apply(turn, m), half);
      a.mean = nsvcd__v3_fma(whole, nsvcd__vmat3_apply(rotation, m), a.turned);
      const nsvcd__v_parted by_fixed = nsvcd__v_part_by_fixed(&a);
      const nsvcd__v_parted by_moving = nsvcd__v_part_by_moving(&a);
      const uint32_t either =
          by_fixed.below | by_fixed.above | by_moving.below | by_moving.above;
      *met &= ~((uint64_t)(either & wanted) << first);
      NSVCD__CERTIFY_GROUPS(p, search, g, h, first, either & wanted, &by_fixed, &by_moving);
    }
    if (!*met) search->waiting &= ~((uint32_t)1 << at);
  }
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/hulls
// In: an item and a span. Out: is there a plane between the two hulls, over all of the span?

#ifndef NSVCD_NO_PROOF
// Vertices first .. first + 15 of a patch, of which `count` are wanted: the slice of them that
// begins with lane l. The last one wanted is repeated in the lanes that are left.
NSVCD__INLINE nsvcd__v3 nsvcd__facet_vertices(const nsvcd__facets *f, size_t patch,
                                              size_t first, size_t count, size_t l) {
  static const float lane[NSVCD__LANES] = {0, 1, 2,  3,  4,  5,  6,  7,
                                           8, 9, 10, 11, 12, 13, 14, 15};
  const nsvcd__vertices all = nsvcd__vertices_of(f, patch);
  const int16_t *x = all.x + first;
  const int16_t *y = all.y + first;
  const int16_t *z = all.z + first;
  nsvcd__v3 q;
  q.x = nsvcd__v_load_int16(x + l);
  q.y = nsvcd__v_load_int16(y + l);
  q.z = nsvcd__v_load_int16(z + l);
  if (count < l + NSVCD__SLICE) {
    const size_t last = count - 1;
    const nsvcd__v end = nsvcd__v_set((float)last);
    const nsvcd__v index = nsvcd__v_load(lane + l);
    q.x = nsvcd__v_pick(index, end, q.x, nsvcd__v_set((float)x[last]));
    q.y = nsvcd__v_pick(index, end, q.y, nsvcd__v_set((float)y[last]));
    q.z = nsvcd__v_pick(index, end, q.z, nsvcd__v_set((float)z[last]));
  }
  const nsvcd__v step = nsvcd__v_set(f->steps[patch]);
  return nsvcd__v3_fma(step, q, nsvcd__v3_set(nsvcd__facet_centre(f, patch)));
}

// A slice of a patch's hull, the last vertex repeated; its body's frame and units.
NSVCD__INLINE nsvcd__v3 nsvcd__hull_of(const nsvcd__facets *f, size_t patch, size_t l) {
  return nsvcd__facet_vertices(f, patch, 0, f->hull_counts[patch], l);
}

// Posed hulls along a direction: how far the moving one, at both ends of the span, stays ahead of
// the resting one, and the difference of the two vertices that say so.
typedef struct nsvcd__support {
  float gap;
  nsvcd__f3 difference;
} nsvcd__support;

// The lesser of the least number so far and that of a slice. What is no number stays none, and
// parts nothing.
static inline float nsvcd__least_of(float least, float of_slice) {
  return least < of_slice || least != least ? least : of_slice;
}

NSVCD__INLINE nsvcd__support nsvcd__support_along(nsvcd__proof *p, nsvcd__f3 normal) {
  // the moving side's lower heights, and the resting side's, negated
  float either[NSVCD__LANES], rest[NSVCD__LANES];
  float lowest = HUGE_VALF;
  float lowest_rest = HUGE_VALF;
  uint32_t starts = 0;
  uint32_t least = 0;
  uint32_t least_rest = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 n = nsvcd__v3_set(normal);
    const nsvcd__v at_start = nsvcd__v3_dot(n, nsvcd__v3_load(p->hull_start, l));
    const nsvcd__v at_end = nsvcd__v3_dot(n, nsvcd__v3_load(p->hull_end, l));
    const nsvcd__v rests = nsvcd__v3_dot(n, nsvcd__v3_load(p->hull_rest, l));
    const nsvcd__v at_rest = nsvcd__v_negate(rests);
    const nsvcd__v at_either = nsvcd__v_min(at_start, at_end);
    nsvcd__v_store(either + l, at_either);
    nsvcd__v_store(rest + l, at_rest);
    lowest = nsvcd__least_of(lowest, nsvcd__v_least(at_either));
    lowest_rest = nsvcd__least_of(lowest_rest, nsvcd__v_least(at_rest));
    starts |= nsvcd__v_le(at_start, at_end) << l;
  }
  NSVCD__EACH_SLICE(l) {
    least |= nsvcd__v_le(nsvcd__v_load(either + l), nsvcd__v_set(lowest)) << l;
    least_rest |= nsvcd__v_le(nsvcd__v_load(rest + l), nsvcd__v_set(lowest_rest)) << l;
  }
  const float highest = -lowest_rest;
  // Were a number not one, no lane would compare: then the last one.
  const size_t a = nsvcd__low_bit(least | 0x8000);
  const size_t b = nsvcd__low_bit(least_rest | 0x8000);
  const int is_start = (starts >> a & 1) != 0;
  const nsvcd__f3 moving = nsvcd__lane_of(is_start ? p->hull_start : p->hull_end, a);
  const nsvcd__support out = {lowest - highest,
                              nsvcd__f3_sub(moving, nsvcd__lane_of(p->hull_rest, b))};
  return out;
}

// a or -a, on the side of b.
static nsvcd__f3 nsvcd__f3_towards(nsvcd__f3 a, nsvcd__f3 b) {
  return nsvcd__f3_scale(a, nsvcd__f3_dot(a, b) < 0 ? -1.0f : 1.0f);
}

static float nsvcd__clamp01(float x) {
  return x < 0 ? 0 : x < 1 ? x : 1;
}

static void nsvcd__remember_plane(nsvcd__memo *memo, nsvcd__f3 normal) {
  // heights are of another query
  if (memo->plane == 0) {
    memset(memo->heights, 0, sizeof memo->heights);
    memset(memo->rest_heights, 0, sizeof memo->rest_heights);
  }
  memo->held = normal;
  memo->plane++;
}

// Is there a plane between two patches over the whole span? A direction is tried by the gap that it
// finds between the hulls, which must be more than the slack and what the span deviates. First
// guesses: the last plane that held, the discs' normals, and the line of centres. Then Gilbert's
// iteration (1966) from there towards the point nearest to 0 of the differences of the two hulls.
// p->memo.held is the one that held.
#define NSVCD__GUESSES 4
static NSVCD__APART int nsvcd__hulls_are_apart(nsvcd__proof *p, size_t i, size_t j,
                                               const nsvcd__span *span) {
  const float slacks = p->ask.motion->scale * p->moving.slacks[i] + p->fixed.slacks[j];
  const float slack = slacks + span->rounding + nsvcd__clearance(p);
  const float reach = nsvcd__patch_reach(&p->moving, i);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 moving = nsvcd__hull_of(&p->moving, i, l);
    nsvcd__v3_store(p->hull_start, l, nsvcd__v3_transform(&span->start, moving));
    nsvcd__v3_store(p->hull_end, l, nsvcd__v3_transform(&span->end, moving));
    nsvcd__v3_store(p->hull_rest, l, nsvcd__hull_of(&p->fixed, j, l));
  }
  const nsvcd__disc moving = nsvcd__disc_at(p->moving.discs, p->moving.body->padded, i);
  const nsvcd__disc fixed = nsvcd__disc_at(p->fixed.discs, p->fixed.body->padded, j);
  const nsvcd__f3 centre = nsvcd__facet_centre(&p->moving, i);
  const nsvcd__f3 start = nsvcd__f3_transform(&span->start, centre);
  const nsvcd__f3 end = nsvcd__f3_transform(&span->end, centre);
  const nsvcd__f3 middle = nsvcd__f3_scale(nsvcd__f3_add(start, end), 0.5f);
  const nsvcd__f3 line = nsvcd__f3_sub(middle, nsvcd__facet_centre(&p->fixed, j));
  const nsvcd__f3 tip = nsvcd__f3_transform(&span->start, moving.normal);
  const nsvcd__f3 turned = nsvcd__f3_sub(tip, span->start.position);
  const nsvcd__f3 guesses[NSVCD__GUESSES] = {p->memo.held,
                                             nsvcd__f3_towards(fixed.normal, line),
                                             nsvcd__f3_towards(turned, line), line};
  nsvcd__f3 nearest = {0, 0, 0};
  p->work++;
  NSVCD__TALLY(planes, 1);
  for (size_t step = 0; step < NSVCD__GUESSES + NSVCD__PLANE_STEPS; step++) {
    const nsvcd__f3 normal = step < NSVCD__GUESSES ? guesses[step] : nearest;
    const nsvcd__support found = nsvcd__support_along(p, normal);
    const float length = nsvcd__f3_length(normal);
    if (found.gap > 0 && found.gap > slack * length + nsvcd__deviation(span, normal, reach)) {
      nsvcd__remember_plane(&p->memo, normal);
      return 1;
    }
    if (step + 1 < NSVCD__GUESSES) continue;
    const nsvcd__f3 way = nsvcd__f3_sub(found.difference, nearest);
    const float square = nsvcd__f3_dot(way, way);
    const float share = square > 0 ? nsvcd__clamp01(-nsvcd__f3_dot(nearest, way) / square) : 0;
    const nsvcd__f3 nearer = nsvcd__f3_add(nearest, nsvcd__f3_scale(way, share));
    nearest = step < NSVCD__GUESSES ? found.difference : nearer;
    // these hulls come this near
    if (nsvcd__f3_dot(nearest, nearest) <= slack * slack) return 0;
  }
  return 0;
}
#endif  // NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- proof/couples
// In: two triangles and a span. Out: parted, or in contact, or neither as long as it is halved.

#ifndef NSVCD_NO_PROOF
// The normal of a triangle (3 corners); its length is twice the area.
static nsvcd__d3 nsvcd__face_normal(const nsvcd__d3 *t) {
  return nsvcd__d3_cross(nsvcd__d3_sub(t[1], t[0]), nsvcd__d3_sub(t[2], t[0]));
}

// The same as a unit vector; 0 where the triangle has no area. What rounding, or fused arithmetic,
// makes of such a triangle's normal is some 1e-16 of its longest edge squared.
static nsvcd__d3 nsvcd__face_direction(const nsvcd__d3 *t) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  double longest = 0;
  for (size_t k = 0; k < 3; k++)
    longest = nsvcd__max(longest, nsvcd__d3_distance2(t[k], t[(k + 1) % 3]));
  const double length = nsvcd__d3_length(n);
  return nsvcd__d3_scale(n, length > 1e-9 * longest ? 1 / length : 0);
}

typedef struct nsvcd__nearest {
  double square;  // of the distance
  nsvcd__d3 on_a, on_b;
} nsvcd__nearest;

static double nsvcd__clamp_share(double x) {
  return x > 0 ? (x < 1 ? x : 1) : 0;
}

static void nsvcd__keep_nearer(nsvcd__nearest *best, nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 d = nsvcd__d3_sub(a, b);
  const double square = nsvcd__d3_dot(d, d);
  if (square >= best->square) return;
  best->square = square;
  best->on_a = a;
  best->on_b = b;
}

// The nearest points of the edges a0 a1 and b0 b1 (Ericson 2005, 5.1.9).
static void nsvcd__edges_nearest(nsvcd__d3 a0, nsvcd__d3 a1, nsvcd__d3 b0, nsvcd__d3 b1,
                                 nsvcd__nearest *best) {
  const nsvcd__d3 u = nsvcd__d3_sub(a1, a0);
  const nsvcd__d3 v = nsvcd__d3_sub(b1, b0);
  const nsvcd__d3 w = nsvcd__d3_sub(a0, b0);
  const double uu = nsvcd__d3_dot(u, u);
  const double vv = nsvcd__d3_dot(v, v);
  const double uv = nsvcd__d3_dot(u, v);
  const double uw = nsvcd__d3_dot(u, w);
  const double vw = nsvcd__d3_dot(v, w);
  const double determinant = uu * vv - uv * uv;
  double s = 0;
  if (determinant > 1e-14 * uu * vv) s = nsvcd__clamp_share((uv * vw - uw * vv) / determinant);
  const double t = vv > 0 ? nsvcd__clamp_share((uv * s + vw) / vv) : 0;
  s = uu > 0 ? nsvcd__clamp_share((uv * t - uw) / uu) : 0;
  nsvcd__keep_nearer(best, nsvcd__d3_mix(a0, a1, s), nsvcd__d3_mix(b0, b1, t));
}

// The foot of x on the plane of a triangle, if it is within the triangle.
static int nsvcd__foot_within(nsvcd__d3 x, const nsvcd__d3 *t, nsvcd__d3 *foot) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  const double square = nsvcd__d3_dot(n, n);
  if (!(square > 0)) return 0;
  const double height = nsvcd__d3_dot(n, nsvcd__d3_sub(x, t[0])) / square;
  *foot = nsvcd__d3_sub(x, nsvcd__d3_scale(n, height));
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    if (nsvcd__d3_dot(n, nsvcd__d3_cross(edge, nsvcd__d3_sub(*foot, t[k]))) < -1e-12 * square)
      return 0;
  }
  return 1;
}

// Do two triangles meet where an edge of one passes through the other? Heights of corners over the
// other's plane are in units of the length of its normal, which is not made unit.
static int nsvcd__triangles_meet(const nsvcd__d3 *a, const nsvcd__d3 *b, nsvcd__d3 *point) {
  const nsvcd__d3 *of[2] = {a, b};
  double heights[2][3];
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__d3 *other = of[1 - n];
    const nsvcd__d3 normal = nsvcd__face_normal(other);
    size_t above = 0;
    size_t below = 0;
    for (size_t k = 0; k < 3; k++) {
      heights[n][k] = nsvcd__d3_dot(normal, nsvcd__d3_sub(of[n][k], other[0]));
      above += heights[n][k] > 0;
      below += heights[n][k] < 0;
    }
    if (above == 3 || below == 3) return 0;
  }
  for (size_t n = 0; n < 6; n++) {
    const nsvcd__d3 *edges = of[n / 3];
    const size_t k = n % 3;
    const double h0 = heights[n / 3][k];
    const double h1 = heights[n / 3][(k + 1) % 3];
    if ((h0 > 0 && h1 > 0) || (h0 < 0 && h1 < 0) || !(fabs(h0 - h1) > 0)) continue;
    const nsvcd__d3 through = nsvcd__d3_mix(edges[k], edges[(k + 1) % 3], h0 / (h0 - h1));
    if (nsvcd__foot_within(through, of[1 - n / 3], point)) return 1;
  }
  return 0;
}

// How many corners of a triangle there are to look at: of a point or a segment, which a round body
// has, as nsvcd_encode_sphere and nsvcd_encode_capsule list it, 1 or 2.
static size_t nsvcd__corners_of(const nsvcd__d3 *t) {
  if (nsvcd__d3_distance2(t[1], t[2]) > 0) return 3;
  return nsvcd__d3_distance2(t[0], t[1]) > 0 ? 2 : 1;
}

// The nearest points of two triangles; the distance is 0 where they meet.
static nsvcd__nearest nsvcd__nearest_of(const nsvcd__d3 *a, const nsvcd__d3 *b) {
  const size_t corners_a = nsvcd__corners_of(a);
  const size_t corners_b = nsvcd__corners_of(b);
  const size_t edges_a = corners_a < 3 ? 1 : 3;
  const size_t edges_b = corners_b < 3 ? 1 : 3;
  nsvcd__nearest best = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
  nsvcd__d3 point;
  if (corners_a > 1 && corners_b > 1 && nsvcd__triangles_meet(a, b, &point)) {
    best.square = 0;
    best.on_a = point;
    best.on_b = point;
    return best;
  }
  for (size_t k = 0; k < edges_a; k++) {
    for (size_t n = 0; n < edges_b; n++)
      nsvcd__edges_nearest(a[k], a[(k + 1) % 3], b[n], b[(n + 1) % 3], &best);
  }
  for (size_t k = 0; k < corners_a && corners_b == 3; k++)
    if (nsvcd__foot_within(a[k], b, &point)) nsvcd__keep_nearer(&best, a[k], point);
  for (size_t k = 0; k < corners_b && corners_a == 3; k++)
    if (nsvcd__foot_within(b[k], a, &point)) nsvcd__keep_nearer(&best, point, b[k]);
  return best;
}

static void nsvcd__place_triangle(const nsvcd__placement *at, const nsvcd__d3 *corners,
                                  nsvcd__d3 *out) {
  for (size_t k = 0; k < 3; k++) out[k] = nsvcd__place_point(at, corners[k]);
}

// Two listed triangles, one of each body, in their frames.
typedef struct nsvcd__couple {
  size_t moving_patch, fixed_patch, moving_listing, fixed_listing;
  nsvcd__d3 moving[3], fixed[3];
  // of the moving one, from its body's origin, in its body's units
  double reach;
  // quanta, and rounding in double
  double slack;
  double rounding;
} nsvcd__couple;

static nsvcd__couple nsvcd__couple_of(const nsvcd__proof *p, size_t i, size_t j, size_t a,
                                      size_t b) {
  nsvcd__couple couple = {i, j, a, b, {{0, 0, 0}}, {{0, 0, 0}}, 0, 0, 0};
  nsvcd__facet_triangle(&p->moving, i, a, couple.moving);
  nsvcd__facet_triangle(&p->fixed, j, b, couple.fixed);
  for (size_t k = 0; k < 3; k++) {
    const double reach = nsvcd__d3_length(couple.moving[k]);
    couple.reach = reach > couple.reach ? reach : couple.reach;
  }
  couple.rounding =
      NSVCD__SAME_PLACE * ((double)p->given.lengths + nsvcd__d3_length(p->arc.from));
  const double moving_quantum = p->arc.scale * (double)p->moving.quanta[i];
  couple.slack = moving_quantum + (double)p->fixed.quanta[j] + couple.rounding;
  couple.slack += NSVCD__SAME_PLACE * nsvcd__d3_length(p->arc.moved);
  return couple;
}

// What is said of two triangles a share u of the arc later than its start.
static nsvcd__contact nsvcd__contact_at(const nsvcd__proof *p, const nsvcd__couple *couple,
                                        double u, const nsvcd__nearest *nearest) {
  const nsvcd__d3 face = nsvcd__face_direction(couple->fixed);
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest->on_a, nearest->on_b);
  const double distance = sqrt(nearest->square);
  const int touches = distance <= couple->rounding;
  nsvcd__contact out;
  out.tick = (double)p->arc.first + u * (double)p->arc.ticks;
  out.distance = touches ? 0 : distance;
  out.point = nearest->on_b;
  out.normal = touches ? face : nsvcd__d3_unit(apart, nsvcd__d3_of(0, 0, 0));
  out.moving_triangle =
      nsvcd__facet_number(&p->moving, couple->moving_patch, couple->moving_listing);
  out.fixed_triangle =
      nsvcd__facet_number(&p->fixed, couple->fixed_patch, couple->fixed_listing);
  out.moving_patch = (uint16_t)couple->moving_patch;
  out.fixed_patch = (uint16_t)couple->fixed_patch;
  return out;
}

// Two triangles come within the clearance a share u of the arc later than its start. ANSWERED if
// that is an answer, SHRUNK if there may be a better one.
static nsvcd__outcome nsvcd__take_contact(nsvcd__proof *p, const nsvcd__couple *couple,
                                          double u, const nsvcd__nearest *nearest) {
  p->known.has_contact = 1;
  p->known.found = nsvcd__contact_at(p, couple, u, nearest);
  if (p->ask.measure > 0) {
    p->high = p->known.found.distance;
    p->ask.clearance = nsvcd__max(p->low, p->high - p->ask.measure);
    return p->ask.clearance > p->low ? NSVCD__SHRUNK : NSVCD__ANSWERED;
  }
  if (p->ask.first > 0) {
    p->ask.end = p->known.found.tick - p->ask.first;
    return p->ask.end > 0 ? NSVCD__SHRUNK : NSVCD__ANSWERED;
  }
  return NSVCD__ANSWERED;
}

// Two triangles come so near from u0 to u1 of the arc that it cannot be told whether they touch.
static NSVCD__APART void nsvcd__take_doubt(nsvcd__proof *p, const nsvcd__couple *couple,
                                           double u0, double u1) {
  const double tick = (double)p->arc.first + u0 * (double)p->arc.ticks;
  const double middle = 0.5 * (u0 + u1);
  nsvcd__d3 posed[3];
  const size_t left = p->ask.in_doubt;
  if (!(p->known.unsure < NSVCD__NEVER) && p->work + left < p->ask.limit)
    p->ask.limit = p->work + left;
  if (!(tick < p->known.unsure)) return;
  nsvcd__place_triangle(nsvcd__placed_at(p, middle), couple->moving, posed);
  const nsvcd__nearest nearest = nsvcd__nearest_of(posed, couple->fixed);
  p->known.doubt = nsvcd__contact_at(p, couple, middle, &nearest);
  p->known.unsure = tick;
  if (p->ask.doubts_end) p->ask.end = nsvcd__min(p->ask.end, tick);
}

// What of the arc matters: the share of it at which the rest does not.
static double nsvcd__arc_limit(const nsvcd__proof *p) {
  return (p->ask.end - (double)p->arc.first) / (double)p->arc.ticks;
}

// Does the plane with this unit normal part the couple from u0 to u1 of the arc? Between these
// times a point at r metres is off its chord by (u1 - u0)^2 (bulge r + drift), of the whole arc;
// along a direction n, where the arc is a turn about one axis a, by |n x a| of that bulge: see
// motion/segments.
static int nsvcd__plane_parts(nsvcd__proof *p, const nsvcd__couple *couple, double u0,
                              double u1, nsvcd__d3 normal) {
  const nsvcd__arc *arc = &p->arc;
  const nsvcd__placement *start = nsvcd__placed_at(p, u0);
  const nsvcd__placement *end = nsvcd__placed_at(p, u1);
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 at_start = nsvcd__place_point(start, couple->moving[k]);
    const nsvcd__d3 at_end = nsvcd__place_point(end, couple->moving[k]);
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_start));
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_end));
    highest = nsvcd__max(highest, nsvcd__d3_dot(normal, couple->fixed[k]));
  }
  double off_axis = 1;
  if (arc->has_axis) off_axis = nsvcd__d3_length(nsvcd__d3_cross(normal, arc->axis)) + 1e-6;
  const double bulge = arc->bulge * couple->reach * off_axis;
  const double deviation = (u1 - u0) * (u1 - u0) * (bulge + arc->drift);
  return lowest - highest > p->ask.clearance + couple->slack + deviation;
}

// Is the foot of x on the plane of a triangle within it, farther than `margin` from its edges?
static int nsvcd__foot_well_within(nsvcd__d3 x, const nsvcd__d3 *t, double margin) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  const double size = nsvcd__d3_length(n);
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    const double within = nsvcd__d3_dot(n, nsvcd__d3_cross(edge, nsvcd__d3_sub(x, t[k])));
    if (!(within > margin * size * nsvcd__d3_length(edge))) return 0;
  }
  return 1;
}

// Have two heights different signs, clear of 0 by their margins?
static int nsvcd__are_opposed(double before, double least_before, double after,
                              double least_after) {
  const int falls = before > least_before && after < -least_after;
  const int rises = before < -least_before && after > least_after;
  return falls || rises;
}

// Is x on different sides of a triangle's plane, farther than `margin` from it, at two times?
static int nsvcd__changes_sides(nsvcd__d3 x0, const nsvcd__d3 *t0, nsvcd__d3 x1,
                                const nsvcd__d3 *t1, double margin) {
  const nsvcd__d3 n0 = nsvcd__face_normal(t0);
  const nsvcd__d3 n1 = nsvcd__face_normal(t1);
  const double before = nsvcd__d3_dot(n0, nsvcd__d3_sub(x0, t0[0]));
  const double after = nsvcd__d3_dot(n1, nsvcd__d3_sub(x1, t1[0]));
  return nsvcd__are_opposed(before, margin * nsvcd__d3_length(n0), after,
                            margin * nsvcd__d3_length(n1));
}

// A couple at three times: the moving triangle's corners.
typedef struct nsvcd__passage {
  nsvcd__d3 corners[3][3];
  // no point of it moves farther between these times, seen from the fixed one
  double way;
} nsvcd__passage;

// Do two edges pass through each other: do they change sides, and are their lines nearest to each
// other well within both? The side is the sign of the volume of the tetrahedron of both.
static int nsvcd__edges_cross(const nsvcd__passage *passage, size_t k, nsvcd__d3 b0,
                              nsvcd__d3 b1, double margin) {
  const size_t next = (k + 1) % 3;
  const nsvcd__d3 v = nsvcd__d3_sub(b1, b0);
  nsvcd__d3 across[3], from[3];
  double volumes[3];
  for (size_t n = 0; n < 3; n++) {
    const nsvcd__d3 *a = passage->corners[n];
    across[n] = nsvcd__d3_cross(nsvcd__d3_sub(a[next], a[k]), v);
    from[n] = nsvcd__d3_sub(b0, a[k]);
    volumes[n] = nsvcd__d3_dot(across[n], from[n]);
  }
  const nsvcd__d3 u = nsvcd__d3_sub(passage->corners[1][next], passage->corners[1][k]);
  const double size = nsvcd__d3_length(across[1]);
  const double lengths = nsvcd__d3_length(u) * nsvcd__d3_length(v);
  if (!(size > 0.01 * lengths)) return 0;
  if (!nsvcd__are_opposed(volumes[0], margin * size, volumes[2], margin * size)) return 0;
  const double square = size * size;
  const double s = nsvcd__d3_dot(nsvcd__d3_cross(from[1], v), across[1]) / square;
  const double t = nsvcd__d3_dot(nsvcd__d3_cross(from[1], u), across[1]) / square;
  // the lines' nearest points move no farther along them
  const double room = 4 * passage->way * lengths / size;
  const double room_s = room / nsvcd__d3_length(u);
  const double room_t = room / nsvcd__d3_length(v);
  return s > room_s && s < 1 - room_s && t > room_t && t < 1 - room_t;
}

// Has a couple met between u0 and u1 of the arc, at that speed, since a corner has passed through
// the other triangle, or an edge through an edge? That is how faces meet which are parallel then:
// at no single time can it be seen in rounded numbers.
static int nsvcd__couple_passes(nsvcd__proof *p, const nsvcd__couple *couple, double u0,
                                double u1, double speed) {
  const nsvcd__d3 *fixed = couple->fixed;
  const double margin = couple->rounding;
  const double times[3] = {u0, 0.5 * (u0 + u1), u1};
  nsvcd__passage passage;
  for (size_t n = 0; n < 3; n++)
    nsvcd__place_triangle(nsvcd__placed_at(p, times[n]), couple->moving, passage.corners[n]);
  const nsvcd__d3 *start = passage.corners[0];
  const nsvcd__d3 *middle = passage.corners[1];
  const nsvcd__d3 *end = passage.corners[2];
  passage.way = speed * (u1 - u0);
  const double room = 2 * passage.way;
  for (size_t k = 0; k < 3; k++) {
    const int is_over = nsvcd__foot_well_within(middle[k], fixed, room);
    if (is_over && nsvcd__changes_sides(start[k], fixed, end[k], fixed, margin)) return 1;
    const int is_under = nsvcd__foot_well_within(fixed[k], middle, room);
    if (is_under && nsvcd__changes_sides(fixed[k], start, fixed[k], end, margin)) return 1;
    for (size_t n = 0; n < 3; n++) {
      if (nsvcd__edges_cross(&passage, k, fixed[n], fixed[(n + 1) % 3], margin)) return 1;
    }
  }
  return 0;
}

static void nsvcd__certify_couple(const nsvcd__proof *p, const nsvcd__couple *couple,
                                  double u0, double u1) {
  const nsvcd__f3 plane = nsvcd__d3_narrow(p->memo.parting);
  const float normal[3] = {plane.x, plane.y, plane.z};
  NSVCD__CERTIFY(NSVCD__BY_TRIANGLES, couple->moving_patch, couple->fixed_patch,
                 couple->moving_listing, couple->fixed_listing, nsvcd__time_in_arc(p, u0),
                 nsvcd__time_in_arc(p, u1), normal);
  (void)couple;
  (void)normal;
  (void)u0;
  (void)u1;
}

// A share u of the arc later than its start: the nearest points of a couple.
static nsvcd__nearest nsvcd__couple_nearest(nsvcd__proof *p, const nsvcd__couple *couple,
                                            double u) {
  nsvcd__d3 posed[3];
  nsvcd__place_triangle(nsvcd__placed_at(p, u), couple->moving, posed);
  return nsvcd__nearest_of(posed, couple->fixed);
}

// A couple that comes so near from u0 to u1 of the arc, the nearest at `when`, that it cannot be
// told whether it touches: a doubt. But where distances are measured, less is said, for certain:
// these come no nearer than that. Then the clearance is lowered and the part to be looked at again,
// TOO_LONG; ANSWERED where it is as low as is known anyway.
static nsvcd__outcome nsvcd__settle_doubt(nsvcd__proof *p, const nsvcd__couple *couple,
                                          double u0, double u1, double when) {
  if (!(p->ask.measure > 0)) {
    nsvcd__take_doubt(p, couple, u0, u1);
    return NSVCD__SETTLED;
  }
  const nsvcd__nearest nearest = nsvcd__couple_nearest(p, couple, when);
  const double distance = sqrt(nearest.square);
  if (distance < p->high) (void)nsvcd__take_contact(p, couple, when, &nearest);
  const double parted = distance - 2 * (couple->slack + p->given.tolerance);
  p->ask.clearance = nsvcd__max(p->low, nsvcd__min(p->ask.clearance, parted));
  return p->ask.clearance > p->low ? NSVCD__TOO_LONG : NSVCD__ANSWERED;
}

// What becomes of a part of the arc that is too short to be halved. Where the couple has met by
// passing, the time is narrowed down to rounding, and is the contact's. If not, it is a doubt.
static NSVCD__APART nsvcd__outcome nsvcd__settle_short_part(nsvcd__proof *p,
                                                            const nsvcd__couple *couple,
                                                            double u0, double u1,
                                                            double speed) {
  int passes = nsvcd__couple_passes(p, couple, u0, u1, speed);
  const int has_met = passes;
  for (size_t n = 0; passes && n < NSVCD__HALVINGS; n++) {
    const double middle = 0.5 * (u0 + u1);
    p->work++;
    const int in_first = nsvcd__couple_passes(p, couple, u0, middle, speed);
    passes = in_first || nsvcd__couple_passes(p, couple, middle, u1, speed);
    if (!passes) break;
    u0 = in_first ? u0 : middle;
    u1 = in_first ? middle : u1;
  }
  const double when = 0.5 * (u0 + u1);
  if (!has_met) return nsvcd__settle_doubt(p, couple, u0, u1, when);
  nsvcd__nearest nearest = nsvcd__couple_nearest(p, couple, when);
  nearest.square = 0;
  return nsvcd__take_contact(p, couple, when, &nearest);
}

// Settles a couple from u0 to u1 of an arc in which the moving body only goes along. Then the
// distance is a convex function of time, and no less than the plane at its nearest points says, its
// tangent: Newton's method, from the start on, comes to the first contact and never past it.
static NSVCD__APART nsvcd__outcome nsvcd__settle_straight(nsvcd__proof *p,
                                                          const nsvcd__couple *couple,
                                                          double u0, double u1) {
  const nsvcd__arc *arc = &p->arc;
  const nsvcd__d3 from = nsvcd__placed_at(p, 0)->position;
  const nsvcd__d3 moved = nsvcd__d3_sub(nsvcd__placed_at(p, 1)->position, from);
  const double close = couple->slack + p->given.tolerance;
  nsvcd__d3 *plane = &p->memo.parting;
  double at = u0;
  int shrunk = 0;
  size_t steps = 0;
  for (double u = u0;;) {  // before u it is parted
    const double end = nsvcd__min(u1, nsvcd__arc_limit(p));
    if (!(u < end)) return shrunk ? NSVCD__SHRUNK : NSVCD__SETTLED;
    at = nsvcd__min(at, end);
    p->work++;
    NSVCD__TALLY(pairs, 1);
    if (nsvcd__is_spent(p)) return NSVCD__SPENT;
    const nsvcd__nearest nearest = nsvcd__couple_nearest(p, couple, at);
    const double distance = sqrt(nearest.square);
    const double above = distance - p->ask.clearance;
    if (above <= couple->rounding) {
      if (nsvcd__take_contact(p, couple, at, &nearest) == NSVCD__ANSWERED)
        return NSVCD__ANSWERED;
      shrunk = 1;
      at = u;
      continue;
    }
    *plane = nsvcd__d3_scale(nsvcd__d3_sub(nearest.on_a, nearest.on_b), 1 / distance);
    const double fall = -nsvcd__d3_dot(*plane, moved);
    const double room = above - couple->slack - couple->rounding;
    const double until = fall > 0 ? nsvcd__min(end, at + room / fall) : end;
    if (u < until && nsvcd__plane_parts(p, couple, u, until, *plane)) {
      nsvcd__certify_couple(p, couple, u, until);
      u = until;
    }
    const int is_short = !(room > 0) || arc->speed * (at - u) <= 0.25 * close;
    const int is_unsure = fall > 0 ? !(at < end) : is_short;
    if (u < end && (is_unsure || steps++ == NSVCD__HALVINGS)) {
      // what follows is no nearer
      const nsvcd__outcome part = nsvcd__settle_doubt(p, couple, u, at, at);
      if (part == NSVCD__ANSWERED) return part;
      if (part == NSVCD__SETTLED) u = end;
    } else {
      at = fall > 0 ? at + above / fall : 0.5 * (u + at);
    }
  }
}

// Settles a couple from u0 to u1 of the arc: halves the time until, in each part, a plane parts the
// triangles, or there is a contact, or they come too close to tell. After each doubt parts need be
// less short: what is still asked is whether they meet. The planes tried are the one that parted a
// couple last, and one at the nearest points of the middle.
static NSVCD__APART nsvcd__outcome nsvcd__settle_couple(nsvcd__proof *p,
                                                        const nsvcd__couple *couple, double u0,
                                                        double u1) {
  const nsvcd__arc *arc = &p->arc;
  if (nsvcd__is_straight(arc)) return nsvcd__settle_straight(p, couple, u0, u1);
  const double speed = arc->speed + arc->turn * arc->scale * couple->reach;
  const double close = couple->slack + p->given.tolerance;
  nsvcd__d3 *plane = &p->memo.parting;
  double *ends = p->couple_ends;
  size_t left = 1;
  size_t doubts = 0;
  int shrunk = 0;
  ends[0] = u1;
  for (double u = u0; left > 0;) {
    const double end = nsvcd__min(ends[left - 1], nsvcd__arc_limit(p));
    // a doubt may be the end
    if (!(u < end)) break;
    const double middle = 0.5 * (u + end);
    p->work++;
    NSVCD__TALLY(pairs, 1);
    if (nsvcd__is_spent(p)) return NSVCD__SPENT;
    int apart = nsvcd__plane_parts(p, couple, u, end, *plane);
    if (!apart) {
      const nsvcd__nearest nearest = nsvcd__couple_nearest(p, couple, middle);
      const double distance = sqrt(nearest.square);
      if (distance <= p->ask.clearance + couple->rounding) {
        if (nsvcd__take_contact(p, couple, middle, &nearest) == NSVCD__ANSWERED)
          return NSVCD__ANSWERED;
        shrunk = 1;
        continue;
      }
      *plane = nsvcd__d3_scale(nsvcd__d3_sub(nearest.on_a, nearest.on_b), 1 / distance);
      apart = nsvcd__plane_parts(p, couple, u, end, *plane);
    }
    if (apart) {
      nsvcd__certify_couple(p, couple, u, end);
    } else {
      const double least = 0.25 * close * (double)(1 + doubts);
      const int is_short = speed * (end - u) <= least || left > NSVCD__HALVINGS;
      if (!is_short) {
        ends[left++] = middle;
        p->parts++;
        continue;
      }
      const nsvcd__outcome part = nsvcd__settle_short_part(p, couple, u, end, speed);
      if (part == NSVCD__ANSWERED) return part;
      shrunk |= part == NSVCD__SHRUNK;
      if (part != NSVCD__SETTLED) continue;
      doubts++;
    }
    u = end;
    left--;
  }
  return shrunk ? NSVCD__SHRUNK : NSVCD__SETTLED;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------ proof/blocks
// In: 16 triangles of a patch, and a plane or other triangles. Out: which of them may meet.

#ifndef NSVCD_NO_PROOF
// Corner k of listings first .. first + count - 1, as vertices of their patch, the last one
// repeated to 16: what nsvcd__facet_corner says of each, the patch asked once.
static void nsvcd__block_corners(const nsvcd__facets *f, size_t patch, size_t first,
                                 size_t count, size_t k, uint16_t *vertices) {
  const size_t bytes =
      nsvcd__corner_bytes(f->first_vertex[patch + 1] - f->first_vertex[patch]);
  const size_t at = 3 * (first - f->first_triangle[patch]) + k;
  const unsigned char *corners = f->listings + f->first_byte[patch] + bytes * at;
  const size_t last = count - 1;
  if (bytes == 1) {
    for (size_t l = 0; l < NSVCD__LANES; l++) vertices[l] = corners[3 * (l < last ? l : last)];
    return;
  }
  for (size_t l = 0; l < NSVCD__LANES; l++)
    memcpy(vertices + l, corners + 6 * (l < last ? l : last), 2);
}

// Listings first .. first + count - 1 of a patch, at most 16; the last is repeated.
static void nsvcd__block_load(const nsvcd__facets *f, size_t patch, size_t first, size_t count,
                              nsvcd__block *out) {
  const size_t all = f->first_vertex[patch + 1] - f->first_vertex[patch];
  const int16_t *x = f->vertices + 3 * (size_t)f->first_vertex[patch];
  const int16_t *y = x + all;
  const int16_t *z = y + all;
  const nsvcd__f3 centre = nsvcd__facet_centre(f, patch);
  out->first = first;
  out->count = count;
  for (size_t k = 0; k < 3; k++) {
    uint16_t vertices[NSVCD__LANES];
    int16_t places[3][NSVCD__LANES];
    nsvcd__block_corners(f, patch, first, count, k, vertices);
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      places[0][l] = x[vertices[l]];
      places[1][l] = y[vertices[l]];
      places[2][l] = z[vertices[l]];
    }
    NSVCD__EACH_SLICE(l) {
      nsvcd__v3 integers;
      integers.x = nsvcd__v_load_int16(places[0] + l);
      integers.y = nsvcd__v_load_int16(places[1] + l);
      integers.z = nsvcd__v_load_int16(places[2] + l);
      const nsvcd__v step = nsvcd__v_set(f->steps[patch]);
      const nsvcd__v3 corner = nsvcd__v3_fma(step, integers, nsvcd__v3_set(centre));
      nsvcd__v3_store(out->corners[k], l, corner);
    }
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 a = nsvcd__v3_load(out->corners[0], l);
    const nsvcd__v3 b = nsvcd__v3_load(out->corners[1], l);
    const nsvcd__v3 c = nsvcd__v3_load(out->corners[2], l);
    nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_min(a, b), c));
    nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_max(a, b), c));
  }
}

// Poses the corners of the moving block, into p->posed[which].
static NSVCD__APART void nsvcd__block_pose(nsvcd__proof *p, const nsvcd__transform *at,
                                           size_t which) {
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->moving_block.corners[k], l);
      nsvcd__v3_store(p->posed[which][k], l, nsvcd__v3_transform(at, corner));
    }
  }
}

// Replaces the boxes of the moving block by those of its posed corners, at `ends` (1 or 2) poses.
static void nsvcd__block_box(nsvcd__proof *p, size_t ends) {
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3 low = nsvcd__v3_load(p->posed[0][0], l);
    nsvcd__v3 high = low;
    for (size_t n = 1; n < 3 * ends; n++) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->posed[n / 3][n % 3], l);
      low = nsvcd__v3_min(low, corner);
      high = nsvcd__v3_max(high, corner);
    }
    nsvcd__v3_store(p->moving_block.low, l, low);
    nsvcd__v3_store(p->moving_block.high, l, high);
  }
}

// The box about a block's boxes.
static nsvcd__box nsvcd__block_bounds(const nsvcd__block *block) {
  float low[3], high[3];
  for (size_t k = 0; k < 3; k++) {
    float least = HUGE_VALF;
    float negated = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v above = nsvcd__v_negate(nsvcd__v_load(block->high[k] + l));
      least = nsvcd__least_of(least, nsvcd__v_least(nsvcd__v_load(block->low[k] + l)));
      negated = nsvcd__least_of(negated, nsvcd__v_least(above));
    }
    low[k] = least;
    high[k] = -negated;
  }
  const nsvcd__box out = {nsvcd__f3_load(low), nsvcd__f3_load(high)};
  return out;
}

// Loads up to NSVCD__WINDOW blocks of resting patch j, from listing `first` on, and what they
// extend to. The same patch is often asked for again.
static void nsvcd__window_load(nsvcd__proof *p, size_t j, size_t first) {
  const size_t end = p->fixed.first_triangle[j + 1];
  if (p->memo.window > 0 && p->fixed_blocks[0].first == first) return;
  p->memo.window = 0;
  for (size_t n = first; n < end && p->memo.window < NSVCD__WINDOW; n += NSVCD__LANES) {
    nsvcd__block *block = &p->fixed_blocks[p->memo.window];
    nsvcd__block_load(&p->fixed, j, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
    p->bounds[p->memo.window] = nsvcd__block_bounds(block);
    p->memo.window++;
  }
}

// The lanes of a block that are listings of their own.
static inline uint32_t nsvcd__block_lanes(const nsvcd__block *block) {
  return ((uint32_t)1 << (block->count - 1) << 1) - 1;
}

// Lanes of a block whose boxes come within `margin` of a box along every axis.
NSVCD__INLINE uint32_t nsvcd__lanes_near(const nsvcd__block *block, nsvcd__box box,
                                         float margin) {
  const nsvcd__f3 around = nsvcd__f3_of(margin, margin, margin);
  float low[3], high[3];
  nsvcd__f3_store(nsvcd__f3_sub(box.low, around), low);
  nsvcd__f3_store(nsvcd__f3_add(box.high, around), high);
  uint32_t lanes = 0;
  NSVCD__EACH_SLICE(l) {
    uint32_t slice = NSVCD__SLICE_MASK;
    for (size_t k = 0; k < 3; k++) {
      slice &= nsvcd__v_le(nsvcd__v_load(block->low[k] + l), nsvcd__v_set(high[k]));
      slice &= nsvcd__v_le(nsvcd__v_set(low[k]), nsvcd__v_load(block->high[k] + l));
    }
    lanes |= slice << l;
  }
  return lanes & nsvcd__block_lanes(block);
}

static nsvcd__box nsvcd__box_of_lane(nsvcd__block *block, size_t l) {
  const nsvcd__box out = {nsvcd__lane_of(block->low, l), nsvcd__lane_of(block->high, l)};
  return out;
}

// A margin along normals of any length. Where their squares underflow it is so large that nothing
// is beyond it.
static nsvcd__v nsvcd__margin_along(nsvcd__v3 n, float margin) {
  const nsvcd__v square = nsvcd__v3_dot(n, n);
  const nsvcd__v limit = nsvcd__v_scale(nsvcd__v_sqrt(square), margin);
  return nsvcd__v_pick(square, nsvcd__v_set(1e-30f), nsvcd__v_set(1e30f), limit);
}

// Lanes of a slice, from s on, of a fixed block that planes with these normals, of any length, have
// on one side of lane l of the moving one, at `ends` (1 or 2) poses, by more than `margin`. below:
// the moving one is on the side that the normal points from.
NSVCD__INLINE uint32_t nsvcd__normals_part(nsvcd__proof *p, size_t l, nsvcd__block *fixed,
                                           size_t s, size_t ends, float margin, nsvcd__v3 n,
                                           uint32_t *below) {
  const nsvcd__v3 b0 = nsvcd__v3_load(fixed->corners[0], s);
  const nsvcd__v3 edge1 = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[1], s), b0);
  const nsvcd__v3 edge2 = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[2], s), b0);
  const nsvcd__v height1 = nsvcd__v3_dot(n, edge1);
  const nsvcd__v height2 = nsvcd__v3_dot(n, edge2);
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v low = nsvcd__v_min(zero, nsvcd__v_min(height1, height2));
  const nsvcd__v high = nsvcd__v_max(zero, nsvcd__v_max(height1, height2));
  nsvcd__v lowest = nsvcd__v_set(HUGE_VALF);
  nsvcd__v highest = nsvcd__v_set(-HUGE_VALF);
  for (size_t k = 0; k < 3 * ends; k++) {
    const nsvcd__v3 a = nsvcd__v3_set(nsvcd__lane_of(p->posed[k / 3][k % 3], l));
    const nsvcd__v height = nsvcd__v3_dot(n, nsvcd__v3_sub(a, b0));
    lowest = nsvcd__v_min(lowest, height);
    highest = nsvcd__v_max(highest, height);
  }
  const nsvcd__v limit = nsvcd__margin_along(n, margin);
  *below = nsvcd__v_lt(highest, nsvcd__v_sub(low, limit));
  return nsvcd__v_lt(nsvcd__v_add(high, limit), lowest) | *below;
}

// Normal number k of those that may part two triangles at `ends` (1 or 2) poses: of the fixed ones
// in a slice, of lane l of the moving one, and of an edge of each; of an edge without length, which
// points and segments have, it is that corner's way that counts.
#define NSVCD__NORMALS 11
NSVCD__INLINE nsvcd__v3 nsvcd__normal_to_try(nsvcd__proof *p, size_t l, nsvcd__block *fixed,
                                             size_t s, size_t ends, size_t k) {
  if (k == 1) {
    const nsvcd__f3 a = nsvcd__lane_of(p->posed[0][0], l);
    const nsvcd__f3 u = nsvcd__f3_sub(nsvcd__lane_of(p->posed[0][1], l), a);
    const nsvcd__f3 v = nsvcd__f3_sub(nsvcd__lane_of(p->posed[0][2], l), a);
    return nsvcd__v3_set(nsvcd__f3_cross(u, v));
  }
  const size_t fixed_edge = k == 0 ? 0 : (k - 2) % 3;
  const size_t moving_edge = k == 0 ? 0 : (k - 2) / 3;
  const nsvcd__v3 b = nsvcd__v3_load(fixed->corners[fixed_edge], s);
  const nsvcd__v3 next = nsvcd__v3_load(fixed->corners[(fixed_edge + 1) % 3], s);
  const nsvcd__v3 edge = nsvcd__v3_sub(next, b);
  if (k == 0)
    return nsvcd__v3_cross(edge, nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[2], s), b));
  const nsvcd__f3 a = nsvcd__lane_of(p->posed[0][moving_edge], l);
  const nsvcd__f3 after = nsvcd__lane_of(p->posed[0][(moving_edge + 1) % 3], l);
  nsvcd__f3 other = nsvcd__f3_sub(after, a);
  if (ends == 2 && !(nsvcd__f3_dot(other, other) > 0))
    other = nsvcd__f3_sub(nsvcd__lane_of(p->posed[1][moving_edge], l), a);
  return nsvcd__v3_cross(nsvcd__v3_set(other), edge);
}

#ifdef NSVCD__CERTIFIES
// All couples of lane l and the `apart` lanes of a block, by the planes of their slice, from s on,
// or, where that is NULL, by their boxes.
static void nsvcd__certify_block(nsvcd__proof *p, size_t i, size_t j, size_t l,
                                 const nsvcd__block *b, const nsvcd__span *span,
                                 uint32_t apart, size_t s, const nsvcd__v3 *plane,
                                 uint32_t below) {
  float lanes[3][NSVCD__LANES];
  const nsvcd__block *a = &p->moving_block;
  if (plane) nsvcd__v3_store(lanes, s, *plane);
  for (size_t n = 0; n < b->count; n++) {
    float normal[3] = {0, 0, 0};
    float widest = -HUGE_VALF;
    const float sign = below >> n & 1 ? -1.0f : 1.0f;
    if (!(apart >> n & 1)) continue;
    for (size_t k = 0; k < 3; k++) {
      if (plane) normal[k] = sign * lanes[k][n];
      const float above = a->low[k][l] - b->high[k][n];
      const float under = b->low[k][n] - a->high[k][l];
      if (plane || (above <= widest && under <= widest)) continue;
      widest = above > under ? above : under;
      normal[0] = normal[1] = normal[2] = 0;
      normal[k] = above > under ? 1.0f : -1.0f;
    }
    NSVCD__CERTIFY(NSVCD__BY_TRIANGLES, i, j, a->first + l, b->first + n, span->t_start,
                   span->t_end, normal);
  }
}
#define NSVCD__CERTIFY_BLOCK(p, i, j, l, b, span, apart, s, plane, below) \
  nsvcd__certify_block(p, i, j, l, b, span, apart, s, plane, below)
#else
#define NSVCD__CERTIFY_BLOCK(p, i, j, l, b, span, apart, s, plane, below) ((void)0)
#endif

// Of these lanes of a fixed block, those that the plane which parted a couple last does not part
// from lane l of the moving one as well, by more than `margin`, at `ends` poses. Where there is a
// clearance it parts many: triangles near by have their nearest points along nearly the same
// direction.
static NSVCD__APART uint32_t nsvcd__left_by_last(nsvcd__proof *p, size_t i, size_t j, size_t l,
                                                 nsvcd__block *fixed, size_t ends,
                                                 const nsvcd__span *span, float margin,
                                                 uint32_t met) {
  const nsvcd__v3 normal = nsvcd__v3_set(nsvcd__f3_round(p->memo.parting));
  NSVCD__EACH_SLICE(s) {
    uint32_t below;
    if (!(met >> s & NSVCD__SLICE_MASK)) continue;
    const uint32_t apart =
        nsvcd__normals_part(p, l, fixed, s, ends, margin, normal, &below) << s & met;
    if (span) NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, span, apart, s, &normal, below << s);
    met &= ~apart;
  }
  (void)i;
  (void)j;
  return met;
}

// Of these lanes of the moving block, those that the plane which parted a couple last does not part
// from all of a fixed block, by more than `margin`, at `ends` poses.
static NSVCD__APART uint32_t nsvcd__lanes_left_by_last(nsvcd__proof *p, size_t i, size_t j,
                                                       nsvcd__block *fixed, size_t ends,
                                                       const nsvcd__span *span, float margin,
                                                       uint32_t lanes) {
  const nsvcd__f3 last = nsvcd__f3_round(p->memo.parting);
  const nsvcd__v3 normal = nsvcd__v3_set(last);
  if (!(p->ask.clearance > 0) || !lanes) return lanes;
  float lowest = HUGE_VALF;  // of the fixed block's heights, negated
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(s) {
      const nsvcd__v height = nsvcd__v3_dot(normal, nsvcd__v3_load(fixed->corners[k], s));
      lowest = nsvcd__least_of(lowest, nsvcd__v_least(nsvcd__v_negate(height)));
    }
  }
  const nsvcd__v limit = nsvcd__v_set(margin * nsvcd__f3_length(last) - lowest);
  uint32_t apart = 0;
  NSVCD__EACH_SLICE(s) {
    nsvcd__v height = nsvcd__v3_dot(normal, nsvcd__v3_load(p->posed[0][0], s));
    for (size_t k = 1; k < 3 * ends; k++) {
      const nsvcd__v3 corner = nsvcd__v3_load(p->posed[k / 3][k % 3], s);
      height = nsvcd__v_min(height, nsvcd__v3_dot(normal, corner));
    }
    apart |= nsvcd__v_lt(limit, height) << s;
  }
  apart &= lanes;
  for (uint32_t told = span ? apart : 0; told; told &= told - 1) {
    NSVCD__EACH_SLICE(s)
    NSVCD__CERTIFY_BLOCK(p, i, j, nsvcd__low_bit(told), fixed, span, NSVCD__SLICE_MASK << s, s,
                         &normal, 0);
  }
  (void)i;
  (void)j;
  return lanes & ~apart;
}

// Lanes of a fixed block that neither boxes nor planes part from lane l of the moving one, at
// `ends` poses. span: of patches i and j, for the certificates; NULL for none.
static NSVCD__APART uint32_t nsvcd__row_left(nsvcd__proof *p, size_t i, size_t j, size_t l,
                                             nsvcd__block *fixed, size_t ends,
                                             const nsvcd__span *span, float margin) {
  uint32_t met = nsvcd__lanes_near(fixed, nsvcd__box_of_lane(&p->moving_block, l), margin);
  if (span) NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, span, ~met, 0, NULL, 0);
  if (p->ask.clearance > 0)
    met = nsvcd__left_by_last(p, i, j, l, fixed, ends, span, margin, met);
  for (size_t k = 0; met && k < NSVCD__NORMALS; k++) {
    NSVCD__EACH_SLICE(s) {
      uint32_t below;
      if (!(met >> s & NSVCD__SLICE_MASK)) continue;
      const nsvcd__v3 normal = nsvcd__normal_to_try(p, l, fixed, s, ends, k);
      const uint32_t apart =
          nsvcd__normals_part(p, l, fixed, s, ends, margin, normal, &below) << s & met;
      if (span) NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, span, apart, s, &normal, below << s);
      met &= ~apart;
    }
  }
  (void)i;
  (void)j;
  return met;
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------------- proof/manifold
// In: couples of triangles that are near each other when a contact is. Out: up to four contact
// points that hold the body: those that span the largest area seen along the contact's normal.
//
// Two triangles touch where a corner of one is over the other, or where two edges cross. Of all
// such places the farthest along eight directions are kept, of what is slim those across it too,
// and of these the best four. Where two
// are as far, the one with the lower number is: so the same are chosen again when little has moved.
// Only normals that are much like the contact's count: where a side rises from the floor, corners
// of the floor's triangles are near the side as well, but it is not what the body stands on.

#ifndef NSVCD_NO_PROOF
// Prepares a manifold of contacts with about this normal, unit.
static void nsvcd__begin_places(nsvcd__proof *p, nsvcd__d3 n, double reach, double same) {
  nsvcd__manifold *m = &p->of.kept.manifold;
  const int flattest = fabs(n.x) < fabs(n.y) ? 0 : 1;
  const nsvcd__d3 aside = nsvcd__d3_of(flattest == 0, flattest == 1, 0);
  const nsvcd__d3 u = nsvcd__d3_unit(nsvcd__d3_cross(n, aside), nsvcd__d3_of(1, 0, 0));
  memset(m, 0, sizeof *m);
  m->normal = n;
  m->reach = reach;
  m->same = same;
  // by an eighth of a turn each: the sum of one and the one a quarter on, shortened
  nsvcd__d3 along = u;
  for (int k = 0; k < NSVCD__AROUND; k++) {
    m->along[k] = along;
    m->farthest[k] = -HUGE_VAL;
    along = nsvcd__d3_scale(nsvcd__d3_add(along, nsvcd__d3_cross(n, along)), sqrt(0.5));
  }
  for (int k = NSVCD__AROUND; k < NSVCD__SUPPORTS; k++) m->farthest[k] = HUGE_VAL;
}

// Where what has been found spans little, for how long it is, prepares to look across it, both
// ways, for what is between the eight directions. area: twice what is spanned. Returns 1 if so.
static int nsvcd__look_across(nsvcd__manifold *m, double area) {
  nsvcd__d3 longest = {0, 0, 0};
  for (int k = 0; k < NSVCD__AROUND; k++) {
    for (int n = 0; n < k && m->farthest[k] > -HUGE_VAL && m->farthest[n] > -HUGE_VAL; n++) {
      const nsvcd__d3 way = nsvcd__d3_sub(m->supports[k].point, m->supports[n].point);
      if (nsvcd__d3_dot(way, way) > nsvcd__d3_dot(longest, longest)) longest = way;
    }
  }
  const double square = nsvcd__d3_dot(longest, longest);
  if (!(square > m->same * m->same) || area > NSVCD__SLIM * square) return 0;
  const nsvcd__d3 across = nsvcd__d3_unit(nsvcd__d3_cross(m->normal, longest), m->along[0]);
  for (int k = NSVCD__AROUND; k < NSVCD__SUPPORTS; k++) {
    m->along[k] = nsvcd__d3_scale(across, k == NSVCD__AROUND ? 1 : -1);
    m->farthest[k] = -HUGE_VAL;
    for (int n = 0; n < NSVCD__AROUND; n++) {
      const double place = nsvcd__d3_dot(m->along[k], m->supports[n].point);
      if (!(m->farthest[n] > -HUGE_VAL) || !(place > m->farthest[k])) continue;
      m->farthest[k] = place;
      m->supports[k] = m->supports[n];
      m->numbers[k] = m->numbers[n];
    }
  }
  return 1;
}

// Takes a place where a couple touches, if it is farther than those that are kept. normal: of a
// face, or across two edges, either way round.
static NSVCD__APART void nsvcd__keep_place(nsvcd__proof *p, const nsvcd__couple *couple,
                                           nsvcd__d3 on_moving, nsvcd__d3 on_fixed,
                                           nsvcd__d3 normal, uint32_t number) {
  nsvcd__manifold *m = &p->of.kept.manifold;
  const double side = nsvcd__d3_dot(normal, m->normal) < 0 ? -1 : 1;
  const nsvcd__d3 way = nsvcd__d3_sub(on_moving, on_fixed);
  const double gap = side * nsvcd__d3_dot(way, normal);
  const double aside = nsvcd__d3_dot(way, way) - gap * gap;
  // past the end of an edge they are not over each other
  if (aside > 0.01 * m->same * m->same) return;
  nsvcd__nearest nearest = {gap > 0 ? gap * gap : 0, on_moving, on_fixed};
  nsvcd__contact contact;
  int known = 0;
  for (int k = 0; k < NSVCD__SUPPORTS; k++) {
    const double place = nsvcd__d3_dot(m->along[k], on_fixed);
    const double more = place - m->farthest[k];
    if (!(more > m->same || (more >= -m->same && number < m->numbers[k]))) continue;
    if (!known) contact = nsvcd__contact_at(p, couple, 0, &nearest);
    known = 1;
    contact.normal = nsvcd__d3_scale(normal, side);
    m->supports[k] = contact;
    m->numbers[k] = number;
    m->farthest[k] = place;
  }
}

// The number of a corner or an edge of a listed triangle: kind 0, of the moving body; 1, of the
// fixed one.
static uint32_t nsvcd__id_of(size_t listing, size_t corner, uint32_t kind) {
  return (uint32_t)(3 * listing + corner) << 2 | kind;
}

// All places where a couple touches, to within the reach. posed: the moving triangle.
static NSVCD__APART void nsvcd__gather_places(nsvcd__proof *p, const nsvcd__couple *couple,
                                              const nsvcd__d3 *posed) {
  const nsvcd__manifold *m = &p->of.kept.manifold;
  const nsvcd__d3 *fixed = couple->fixed;
  const nsvcd__d3 faces[2] = {nsvcd__face_direction(posed), nsvcd__face_direction(fixed)};
  // faces look at each other, along the normal
  const double moving_up = -nsvcd__d3_dot(faces[0], m->normal);
  const double fixed_up = nsvcd__d3_dot(faces[1], m->normal);
  const int moving_faces = (p->moving.body->open ? fabs(moving_up) : moving_up) >= 0.8;
  const int fixed_faces = (p->fixed.body->open ? fabs(fixed_up) : fixed_up) >= 0.8;
  nsvcd__d3 foot;
  int farther = 0;
  for (int k = 0; k < NSVCD__SUPPORTS && !farther; k++) {
    for (int i = 0; i < 3; i++)
      farther |= nsvcd__d3_dot(m->along[k], posed[i]) + m->reach >= m->farthest[k] - m->same;
  }
  for (size_t k = 0; k < 3 && farther; k++) {
    const uint32_t moving_id = nsvcd__id_of(couple->moving_listing, k, 0);
    const uint32_t fixed_id = nsvcd__id_of(couple->fixed_listing, k, 1);
    if (fixed_faces && nsvcd__foot_within(posed[k], fixed, &foot) &&
        nsvcd__d3_distance2(posed[k], foot) <= m->reach * m->reach)
      nsvcd__keep_place(p, couple, posed[k], foot, faces[1], moving_id);
    if (moving_faces && nsvcd__foot_within(fixed[k], posed, &foot) &&
        nsvcd__d3_distance2(fixed[k], foot) <= m->reach * m->reach)
      nsvcd__keep_place(p, couple, foot, fixed[k], faces[0], fixed_id);
    for (size_t i = 0; i < 3; i++) {
      const nsvcd__d3 a = posed[(k + 1) % 3];
      const nsvcd__d3 b = fixed[(i + 1) % 3];
      const nsvcd__d3 u = nsvcd__d3_sub(a, posed[k]);
      const nsvcd__d3 v = nsvcd__d3_sub(b, fixed[i]);
      const nsvcd__d3 across = nsvcd__d3_cross(u, v);
      const double along = nsvcd__d3_dot(across, m->normal);
      const double square = nsvcd__d3_dot(across, across);
      const double lengths = nsvcd__d3_dot(u, u) * nsvcd__d3_dot(v, v);
      nsvcd__nearest nearest = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
      if (!(square > 1e-4 * lengths)) continue;
      if (along * along < 0.64 * square) continue;
      nsvcd__edges_nearest(posed[k], a, fixed[i], b, &nearest);
      if (!(nearest.square <= m->reach * m->reach)) continue;
      const uint32_t number = moving_id * 3 + fixed_id * 5 + (uint32_t)(1 + i) * 0x9e3779b9u;
      nsvcd__keep_place(p, couple, nearest.on_a, nearest.on_b,
                        nsvcd__d3_unit(across, faces[1]), number | 2);
    }
  }
}

// Twice the area that four places span, seen along the normal.
static double nsvcd__spanned(const nsvcd__manifold *m, const int *of) {
  double most = 0;
  for (int k = 0; k < 3; k++) {
    const nsvcd__d3 a = m->supports[of[0]].point;
    const nsvcd__d3 b = m->supports[of[1 + k]].point;
    const nsvcd__d3 c = m->supports[of[1 + (k + 1) % 3]].point;
    const nsvcd__d3 d = m->supports[of[1 + (k + 2) % 3]].point;
    const nsvcd__d3 both = nsvcd__d3_cross(nsvcd__d3_sub(b, a), nsvcd__d3_sub(d, c));
    most = nsvcd__max(most, fabs(nsvcd__d3_dot(both, m->normal)));
  }
  return most;
}

// Chooses the contacts: the numbers of those supports, and twice the area that they span. Returns
// how many.
static NSVCD__APART int nsvcd__choose_four(const nsvcd__manifold *m, int *chosen,
                                           double *area) {
  int kept[NSVCD__SUPPORTS];
  int count = 0;
  // each place once, those with lower numbers first
  for (int k = 0; k < NSVCD__SUPPORTS; k++) {
    int at = count;
    int is_new = m->farthest[k] > -HUGE_VAL && m->farthest[k] < HUGE_VAL;
    for (int n = 0; n < count; n++) {
      const nsvcd__d3 other = m->supports[kept[n]].point;
      is_new &= nsvcd__d3_distance2(m->supports[k].point, other) > m->same * m->same;
    }
    if (!is_new) continue;
    for (; at > 0 && m->numbers[k] < m->numbers[kept[at - 1]]; at--) kept[at] = kept[at - 1];
    kept[at] = k;
    count++;
  }
  memcpy(chosen, kept, sizeof(int) * (size_t)(count < 4 ? count : 4));
  *area = 0;
  for (int n = count; n < 4 && count > 0; n++) kept[n] = kept[count - 1];
  if (count > 0 && count <= 4) *area = nsvcd__spanned(m, kept);
  if (count <= 4) return count;
  for (int all = 0; all < 1 << count; all++) {
    int four[NSVCD__SUPPORTS];
    int size = 0;
    for (int n = 0; n < count; n++)
      if (all >> n & 1) four[size++] = kept[n];
    if (size != 4) continue;
    const double spanned = nsvcd__spanned(m, four);
    if (!(spanned > 1.001 * *area)) continue;
    *area = spanned;
    memcpy(chosen, four, 4 * sizeof *chosen);
  }
  return 4;
}
#endif  // NSVCD_NO_PROOF

// --------------------------------------------------------------------------------- proof/witnesses
// In: an item, an arc and a share of it. Out: a contact: two triangles that meet there, or come
// within the clearance; with a skin, what touches at the start and which directions undo it.

#ifndef NSVCD_NO_PROOF
// How far the moving triangle of a touch must go along n until it is beyond the other; negative if
// it is already.
static double nsvcd__lift_along(nsvcd__d3 n, const nsvcd__touch *t) {
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(n, t->moving[k]));
    highest = nsvcd__max(highest, nsvcd__d3_dot(n, t->fixed[k]));
  }
  return highest - lowest;
}

// The direction across an edge of each triangle of a touch, unit: the k-th of 9. 0 if they are
// parallel.
static nsvcd__d3 nsvcd__across_edges(const nsvcd__touch *t, size_t k) {
  const nsvcd__d3 u = nsvcd__d3_sub(t->moving[(k + 1) % 3], t->moving[k % 3]);
  const nsvcd__d3 v = nsvcd__d3_sub(t->fixed[(k / 3 + 1) % 3], t->fixed[k / 3]);
  return nsvcd__d3_unit(nsvcd__d3_cross(u, v), nsvcd__d3_of(0, 0, 0));
}

// Is a touch too deep for the skin in every direction? Two triangles are parted soonest along a
// normal of one, or across an edge of each (the separating axes).
static int nsvcd__is_deep(const nsvcd__proof *p, const nsvcd__touch *t) {
  const nsvcd__d3 lift = nsvcd__d3_widen(p->ask.motion->lift);
  const double most = p->ask.skin - p->given.clearance;
  for (size_t k = 0; k < 12; k++) {
    nsvcd__d3 n = k < 3 ? t->ways[k] : nsvcd__across_edges(t, k - 3);
    if (!(nsvcd__d3_dot(n, n) > 0.5)) continue;
    for (int side = 0; side < 2; side++) {
      const double lifted = nsvcd__d3_dot(lift, n);
      if (lifted + nsvcd__lift_along(n, t) <= most) return 0;
      n = nsvcd__d3_scale(n, -1);
    }
  }
  return 1;
}

// Does a lift along n, by what is left of the skin in that direction, undo a touch? If it has to
// push anything, then not through both faces. Through one of them is no harm: a side that rises
// from the rim on which a cone stands looks up, and the floor under it looks up too.
static int nsvcd__undoes(const nsvcd__proof *p, nsvcd__d3 n, const nsvcd__touch *t) {
  const double lift = nsvcd__lift_along(n, t);
  const double lifted = nsvcd__d3_dot(nsvcd__d3_widen(p->ask.motion->lift), n);
  if (!(nsvcd__d3_dot(n, n) > 0.5) || lifted + lift + p->given.clearance > p->ask.skin)
    return 0;
  if (lift < 0) return 1;
  return nsvcd__d3_dot(n, t->ways[0]) > -0.3 || nsvcd__d3_dot(n, t->ways[1]) > -0.3;
}

// The square of the distance of two triangles, the moving one gone so far along n.
static double nsvcd__gap_after(const nsvcd__touch *t, nsvcd__d3 n, double way) {
  nsvcd__d3 moved[3];
  for (int k = 0; k < 3; k++) moved[k] = nsvcd__d3_add(t->moving[k], nsvcd__d3_scale(n, way));
  return nsvcd__nearest_of(moved, t->fixed).square;
}

// How far along n the moving triangle of a touch must go until it is beyond the clearance for good,
// if it is so after `most`; -HUGE_VAL: it is all the way. The distance is convex on it: thirds
// find where it is least, and halves where it is the clearance.
static NSVCD__APART double nsvcd__way_out(const nsvcd__touch *t, nsvcd__d3 n, double clearance,
                                          double most) {
  // parallel faces meet at one time only
  const double reach = clearance + 0.003 * most;
  const double square = reach * reach;
  // as it nearly always is
  if (nsvcd__gap_after(t, n, 0.998 * most) <= square) return most;
  double low = 0;
  double high = most;
  double within = 0;
  int found = nsvcd__gap_after(t, n, 0) <= square;
  for (int k = 0; k < 16 && !found; k++) {
    const double third = (high - low) / 3;
    const double before = nsvcd__gap_after(t, n, low + third);
    const double after = nsvcd__gap_after(t, n, high - third);
    found = before <= square || after <= square;
    within = after <= square ? high - third : low + third;
    if (before < after) high -= third;
    if (!(before < after)) low += third;
  }
  if (!found) return -HUGE_VAL;
  for (double beyond = most; beyond - within > 1e-3 * most;) {
    const double middle = 0.5 * (within + beyond);
    const int touches = nsvcd__gap_after(t, n, middle) <= square;
    within = touches ? middle : within;
    beyond = touches ? beyond : middle;
  }
  return within;
}

// Remembers how deep a touch is along normal k.
static void nsvcd__note_depth(nsvcd__proof *p, size_t k, const nsvcd__touch *t) {
  const nsvcd__d3 n = p->normals[k];
  const double lifted = nsvcd__d3_dot(nsvcd__d3_widen(p->ask.motion->lift), n);
  const double most = nsvcd__lift_along(n, t) + p->given.clearance;
  p->needed = nsvcd__max(p->needed, lifted + most);
  if (!(most > 0) || !(lifted + most > p->depths[k])) return;
  const double depth = lifted + nsvcd__way_out(t, n, p->given.clearance, most);
  p->depths[k] = nsvcd__max(p->depths[k], depth);
}

// Does normal k undo a touch? How far it has to is remembered.
static int nsvcd__undone_by(nsvcd__proof *p, size_t k, const nsvcd__touch *t) {
  if (!nsvcd__undoes(p, p->normals[k], t)) return 0;
  nsvcd__note_depth(p, k, t);
  return 1;
}

// Keeps two triangles that are within the clearance at the start, unless a direction that is known
// undoes that.
static void nsvcd__gather_contact(nsvcd__proof *p, const nsvcd__couple *couple,
                                  const nsvcd__d3 *posed) {
  nsvcd__touch touch;
  memcpy(touch.moving, posed, sizeof touch.moving);
  memcpy(touch.fixed, couple->fixed, sizeof touch.fixed);
  const nsvcd__nearest nearest = nsvcd__nearest_of(posed, couple->fixed);
  const int are_apart = nearest.square > 1e6 * couple->rounding * couple->rounding;
  const nsvcd__d3 way = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
  touch.ways[0] = nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
  touch.ways[1] = nsvcd__face_direction(couple->fixed);
  touch.ways[2] = nsvcd__d3_scale(way, are_apart ? 1 / sqrt(nearest.square) : 0);
  for (size_t k = 0; k < p->normal_count; k++) {
    if (nsvcd__undone_by(p, k, &touch)) return;
  }
  p->too_deep = p->too_deep || nsvcd__is_deep(p, &touch);
  if (p->touch_count < NSVCD__TOUCHES) p->of.touches[p->touch_count++] = touch;
}

// Among the moving block, posed `at`, and a block of the window: looks for a contact a share u of
// the arc later than its start.
static nsvcd__outcome nsvcd__find_witness_in(nsvcd__proof *p, size_t i, size_t j, size_t n,
                                             const nsvcd__placement *at, double u,
                                             float margin) {
  nsvcd__block *fixed = &p->fixed_blocks[n];
  const double clearance = p->ask.clearance;
  const uint32_t nearby = nsvcd__lanes_near(&p->moving_block, p->bounds[n], margin);
  uint32_t lanes = nsvcd__lanes_left_by_last(p, i, j, fixed, 1, NULL, margin, nearby);
  for (; lanes; lanes &= lanes - 1) {
    const size_t l = nsvcd__low_bit(lanes);
    p->work++;
    uint32_t met = nsvcd__row_left(p, i, j, l, fixed, 1, NULL, margin);
    for (; met; met &= met - 1) {
      if (clearance > 0) met = nsvcd__left_by_last(p, i, j, l, fixed, 1, NULL, margin, met);
      if (!met) break;
      const size_t listing = p->moving_block.first + l;
      const nsvcd__couple couple =
          nsvcd__couple_of(p, i, j, listing, fixed->first + nsvcd__low_bit(met));
      nsvcd__d3 posed[3];
      nsvcd__nearest nearest = {0, {0, 0, 0}, {0, 0, 0}};
      nsvcd__place_triangle(at, couple.moving, posed);
      p->work++;
      if (p->ask.gathers == NSVCD__SUPPORTING) {
        nsvcd__gather_places(p, &couple, posed);
        continue;
      }
      if (nsvcd__triangles_meet(posed, couple.fixed, &nearest.on_b)) {
        nearest.on_a = nearest.on_b;
      } else {
        if (!(clearance > 0)) continue;
        nearest = nsvcd__nearest_of(posed, couple.fixed);
        if (!(nearest.square <= clearance * clearance)) {
          const nsvcd__d3 way = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
          p->memo.parting = nsvcd__d3_scale(way, 1 / sqrt(nearest.square));
          continue;
        }
      }
      if (p->ask.gathers == NSVCD__TOUCHING) {
        nsvcd__gather_contact(p, &couple, posed);
        continue;
      }
      const nsvcd__outcome contact = nsvcd__take_contact(p, &couple, u, &nearest);
      if (contact == NSVCD__ANSWERED) return contact;
      // They may touch sooner, or come closer.
      const nsvcd__outcome better = nsvcd__settle_couple(p, &couple, 0, 1);
      return better == NSVCD__ANSWERED ? better : contact;
    }
  }
  return NSVCD__NOTHING;
}

// Loads 16 triangles of moving patch i, from listing `first` on. The same are often asked for
// again.
static void nsvcd__moving_block_load(nsvcd__proof *p, size_t i, size_t first) {
  const size_t left = p->moving.first_triangle[i + 1] - first;
  if (p->memo.has_block && p->moving_block.first == first) return;
  p->memo.has_block = 1;
  nsvcd__block_load(&p->moving, i, first, left < NSVCD__LANES ? left : NSVCD__LANES,
                    &p->moving_block);
}

// Looks for a contact of triangles of patches i and j a share u of an arc later than its start.
static nsvcd__outcome nsvcd__find_witness(nsvcd__proof *p, size_t i, size_t j, uint32_t first,
                                          double u) {
  const nsvcd__arc *arc = nsvcd__arc_at(p, first);
  const nsvcd__placement at = nsvcd__placement_at(arc, u);
  const nsvcd__transform rounded = nsvcd__transform_of(&at);
  const float lengths = p->given.lengths + nsvcd__f3_length(rounded.position);
  const float margin = NSVCD__ROUNDING * lengths + nsvcd__clearance(p);
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  NSVCD__TALLY(tries, 1);
  for (size_t b = p->fixed.first_triangle[j]; b < fixed_end;
       b += NSVCD__WINDOW * NSVCD__LANES) {
    nsvcd__window_load(p, j, b);
    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {
      nsvcd__moving_block_load(p, i, a);
      nsvcd__block_pose(p, &rounded, 0);
      nsvcd__block_box(p, 1);
      for (size_t n = 0; n < p->memo.window; n++) {
        p->work++;
        if (nsvcd__is_spent(p)) return NSVCD__NOTHING;
        const nsvcd__outcome found = nsvcd__find_witness_in(p, i, j, n, &at, u, margin);
        if (found != NSVCD__NOTHING) return found;
      }
    }
  }
  return NSVCD__NOTHING;
}

// The arc, and the share of it, that a time counted in ticks is in: it begins at the last knot that
// is not after that time.
static uint32_t nsvcd__arc_of(const nsvcd__motion *motion, double at, double *share) {
  const uint32_t last = motion->ticks - 1;
  const uint32_t tick = at < (double)last ? (uint32_t)at : last;
  const uint32_t a =
      nsvcd__tick_of(&motion->moving, nsvcd__pose_before(&motion->moving, tick));
  const uint32_t b = nsvcd__tick_of(&motion->fixed, nsvcd__pose_before(&motion->fixed, tick));
  const uint32_t first = a > b ? a : b;
  *share = (at - (double)first) / (double)(nsvcd__next_knot(motion, first) - first);
  return first;
}

// Looks for a contact of an item where its spheres are nearest, if that still matters.
static nsvcd__outcome nsvcd__seek_item(nsvcd__proof *p, const nsvcd__search *search,
                                       nsvcd__item *item) {
  const double start = (double)search->begin[item->segment];
  const double end = nsvcd__min((double)search->begin[item->segment + 1u], p->clipped_end);
  const double tick = start + (double)item->share * (end - start);
  double u;
  item->sought = 1;
  if (!(tick < p->ask.end)) return NSVCD__NOTHING;
  const uint32_t first = nsvcd__arc_of(p->ask.motion, tick, &u);
  return nsvcd__find_witness(p, item->moving, item->fixed, first, u);
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/items
// In: fresh items, as the search finds them. Out: each is parted by a plane between its hulls or by
// its triangles, or in contact, or kept as a doubt.

#ifndef NSVCD_NO_PROOF
// Lane l of the moving block, posed at both ends of a span from u0 to u1 of the arc, and block n of
// the window: couples that planes do not part are settled one by one, and what parts one may part
// others. TOO_LONG when they have asked for more than `patience` parts of the span; without any,
// when there is such a couple.
static nsvcd__outcome nsvcd__settle_row(nsvcd__proof *p, size_t i, size_t j, size_t l,
                                        size_t n, const nsvcd__span *span, float margin,
                                        double u0, double u1, size_t patience) {
  nsvcd__block *fixed = &p->fixed_blocks[n];
  const float quanta = nsvcd__quanta_of(p, i, j);
  const float reach = p->moving.body->extent + p->moving.quanta[i];
  p->work++;
  uint32_t met = nsvcd__row_left(p, i, j, l, fixed, 2, span, margin);
  for (; met; met &= met - 1) {
    const nsvcd__f3 last = nsvcd__f3_round(p->memo.parting);
    const float along =
        quanta + span->rounding + nsvcd__clearance(p) + nsvcd__deviation(span, last, reach);
    met = nsvcd__left_by_last(p, i, j, l, fixed, 2, span, along, met);
    if (!met) break;
    if (patience == 0) return NSVCD__TOO_LONG;
    const size_t listing = p->moving_block.first + l;
    const nsvcd__couple couple =
        nsvcd__couple_of(p, i, j, listing, fixed->first + nsvcd__low_bit(met));
    const nsvcd__outcome one = nsvcd__settle_couple(p, &couple, u0, u1);
    if (one != NSVCD__SETTLED) return one;
    if (p->parts > patience) return NSVCD__TOO_LONG;
  }
  return NSVCD__SETTLED;
}

// All couples of an item's patches over a span from u0 to u1 of the arc.
static NSVCD__APART nsvcd__outcome nsvcd__settle_triangles(nsvcd__proof *p, size_t i, size_t j,
                                                           const nsvcd__span *span, double u0,
                                                           double u1, size_t patience) {
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  const float reach = p->moving.body->extent + p->moving.quanta[i];
  const float margin = nsvcd__quanta_of(p, i, j) + (span->rounding + span->drift) +
                       nsvcd__clearance(p) + span->bulge * reach;
  p->parts = 0;
  for (size_t b = p->fixed.first_triangle[j]; b < fixed_end;
       b += NSVCD__WINDOW * NSVCD__LANES) {
    nsvcd__window_load(p, j, b);
    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {
      nsvcd__moving_block_load(p, i, a);
      nsvcd__block_pose(p, &span->start, 0);
      nsvcd__block_pose(p, &span->end, 1);
      nsvcd__block_box(p, 2);
      for (size_t n = 0; n < p->memo.window; n++) {
        nsvcd__block *fixed = &p->fixed_blocks[n];
        const uint32_t nearby = nsvcd__lanes_near(&p->moving_block, p->bounds[n], margin);
        const uint32_t lanes =
            nsvcd__lanes_left_by_last(p, i, j, fixed, 2, span, margin, nearby);
        p->work++;
        if (nsvcd__is_spent(p)) return NSVCD__SPENT;
        for (size_t l = 0; l < p->moving_block.count; l++) {
          if (!(nearby >> l & 1))
            NSVCD__CERTIFY_BLOCK(p, i, j, l, fixed, span, 0xffff, 0, NULL, 0);
          if (!(lanes >> l & 1)) continue;
          const nsvcd__outcome row =
              nsvcd__settle_row(p, i, j, l, n, span, margin, u0, u1, patience);
          if (row != NSVCD__SETTLED) return row;
        }
      }
    }
  }
  return NSVCD__SETTLED;
}

static void nsvcd__certify_item(const nsvcd__proof *p, const nsvcd__span *span,
                                const nsvcd__item *item) {
  const float normal[3] = {p->memo.held.x, p->memo.held.y, p->memo.held.z};
  NSVCD__CERTIFY(NSVCD__BY_HULL, item->moving, item->fixed, NSVCD_NONE, NSVCD_NONE,
                 span->t_start, span->t_end, normal);
  (void)normal;
  (void)span;
  (void)item;
}

// Settles an item that no plane parts over its segment, arc by arc. Each arc is halved as often as
// need be: a part of it is parted by a plane between the hulls, or by its triangles.
static nsvcd__outcome nsvcd__settle_item(nsvcd__proof *p, const nsvcd__search *search,
                                         const nsvcd__item *item) {
  const nsvcd__motion *motion = p->ask.motion;
  const uint32_t last = search->begin[item->segment + 1u];
  double *ends = p->arc_ends;
  int is_tried = 1;  // is it all of the segment?
  for (uint32_t at = search->begin[item->segment]; at < last && (double)at < p->ask.end;) {
    double u;
    const uint32_t first = nsvcd__arc_of(motion, (double)at, &u);
    const uint32_t knot = nsvcd__next_knot(motion, first);
    at = last < knot ? last : knot;
    is_tried = is_tried && at == last;
    ends[0] = (double)(at - first) / (double)(knot - first);
    for (size_t left = 1; left > 0;) {
      NSVCD__PAUSE(p);
      nsvcd__arc_at(p, first);
      const double end = nsvcd__min(ends[left - 1], nsvcd__arc_limit(p));
      if (!(u < end)) break;
      p->span = nsvcd__span_of_arc(p, first, u, end);
      const int apart =
          !is_tried && nsvcd__hulls_are_apart(p, item->moving, item->fixed, &p->span);
      is_tried = 0;
      if (apart) {
        nsvcd__certify_item(p, &p->span, item);
      } else {
        const int may_halve = end - u > NSVCD__SHORTEST && left < NSVCD__ARC_PARTS;
        const size_t patience = may_halve ? NSVCD__PATIENCE_TO_PART : (size_t)-1;
        const nsvcd__outcome part =
            nsvcd__settle_triangles(p, item->moving, item->fixed, &p->span, u, end, patience);
        if (part == NSVCD__ANSWERED || part == NSVCD__SPENT) return part;
        if (part == NSVCD__TOO_LONG) ends[left++] = 0.5 * (u + end);
        if (part != NSVCD__SETTLED) continue;
      }
      u = end;
      left--;
    }
  }
  return NSVCD__SETTLED;
}

// Does a plane with the normal that held last part an item's patches over its segment? Neighbours
// of an item that a plane parts ask for the same again: so heights over it are remembered, of a
// moving patch in a segment the least, all allowances taken off, and of a resting one the greatest.
static int nsvcd__held_again(nsvcd__proof *p, const nsvcd__search *search,
                             const nsvcd__item *item) {
  const size_t i = item->moving;
  const size_t j = item->fixed;
  const size_t s = item->segment;
  const nsvcd__span *span = nsvcd__segment_span(p, search, s);
  nsvcd__memo *memo = &p->memo;
  const nsvcd__f3 n = memo->held;
  const float length = nsvcd__f3_length(n);
  const uint32_t key = (uint32_t)(i * NSVCD__MAX_SEGMENTS + s);
  nsvcd__height *above =
      &memo->heights[(NSVCD__GROUP * s + i % NSVCD__GROUP) % NSVCD__HEIGHTS];
  nsvcd__height *below = &memo->rest_heights[j % NSVCD__REST_HEIGHTS];
  if (above->plane != memo->plane || above->key != key) {
    float lowest = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 hull = nsvcd__hull_of(&p->moving, i, l);
      const nsvcd__v3 normal = nsvcd__v3_set(n);
      const nsvcd__v at_start = nsvcd__v3_dot(normal, nsvcd__v3_transform(&span->start, hull));
      const nsvcd__v at_end = nsvcd__v3_dot(normal, nsvcd__v3_transform(&span->end, hull));
      lowest = nsvcd__least_of(lowest, nsvcd__v_least(nsvcd__v_min(at_start, at_end)));
    }
    const float slack = (p->ask.motion->scale * p->moving.slacks[i] + span->rounding) * length;
    above->plane = memo->plane;
    above->key = key;
    above->height =
        lowest - slack - nsvcd__deviation(span, n, nsvcd__patch_reach(&p->moving, i));
  }
  if (below->plane != memo->plane || below->key != j) {
    // negated
    float highest = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v height = nsvcd__v3_dot(nsvcd__v3_set(n), nsvcd__hull_of(&p->fixed, j, l));
      highest = nsvcd__least_of(highest, nsvcd__v_least(nsvcd__v_negate(height)));
    }
    below->plane = memo->plane;
    below->key = (uint32_t)j;
    below->height = p->fixed.slacks[j] * length - highest;
  }
  if (!(above->height > below->height + nsvcd__clearance(p) * length)) return 0;
  nsvcd__certify_item(p, span, item);
  return 1;
}

// Is there any plane that does?
static int nsvcd__item_is_parted(nsvcd__proof *p, const nsvcd__search *search,
                                 const nsvcd__item *item) {
  const nsvcd__span *span = nsvcd__segment_span(p, search, item->segment);
  if (!nsvcd__hulls_are_apart(p, item->moving, item->fixed, span)) return 0;
  nsvcd__certify_item(p, span, item);
  return 1;
}

// Is an item to be looked at before another? The deeper; with `first` the one that is nearest
// earlier in their segment, and once there is a contact that of the earlier segment.
static int nsvcd__is_before(const nsvcd__proof *p, const nsvcd__item *a,
                            const nsvcd__item *b) {
  const int in_time = p->ask.first > 0;
  if (a->segment == b->segment) return in_time ? a->share < b->share : a->depth > b->depth;
  return in_time && p->known.has_contact ? a->segment < b->segment : a->depth > b->depth;
}

static void nsvcd__sort_items(const nsvcd__proof *p, nsvcd__item *items, size_t count) {
  for (size_t n = 1; n < count; n++) {
    const nsvcd__item item = items[n];
    size_t at = n;
    for (; at > 0 && nsvcd__is_before(p, &item, &items[at - 1]); at--)
      items[at] = items[at - 1];
    items[at] = item;
  }
}

// Does a segment still matter?
static int nsvcd__matters(const nsvcd__proof *p, const nsvcd__search *search, size_t segment) {
  return (double)search->begin[segment] < p->ask.end;
}

// Where the end of what matters lies within a segment, that segment is cut off there. What leaves a
// chord by some length leaves that of a part of the time by no more than twice that, along any
// direction.
static NSVCD__APART void nsvcd__clip_segment(nsvcd__proof *p, nsvcd__search *search) {
  size_t s = 0;
  double u;
  if (!(p->ask.end < p->clipped_end)) return;
  p->clipped_end = p->ask.end;
  while (s < search->segments && !((double)search->begin[s + 1] > p->ask.end)) s++;
  if (s == search->segments || !((double)search->begin[s] < p->ask.end)) return;
  nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  const uint32_t first = nsvcd__arc_of(p->ask.motion, p->ask.end, &u);
  const nsvcd__placement at = nsvcd__placement_at(nsvcd__arc_at(p, first), u);
  const nsvcd__transform end = nsvcd__transform_of(&at);
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, l);
  const nsvcd__mat3 turned = nsvcd__mat3_mix(1, &end.rotation, -1, &start);
  const nsvcd__f3 position = nsvcd__lane_of(block->position, l);
  nsvcd__lane_set(nsvcd__f3_sub(end.position, position), block->moved, l);
  nsvcd__lane_set(turned.x, block->turned, l);
  nsvcd__lane_set(turned.y, block->turned + 3, l);
  nsvcd__lane_set(turned.z, block->turned + 6, l);
  if (!(p->clipped >> s & 1)) {
    block->spread[l] += block->drift[l];
    block->bulge[l] *= 2;
    block->drift[l] *= 2;
    block->bulge_along_axis[l] *= 2;
    block->drift_along_axis[l] *= 2;
    block->drift_off_way[l] *= 2;
  }
  p->clipped |= (uint64_t)1 << s;
  p->memo.spans &= ~((uint64_t)1 << s);
  search->posed &= ~((uint64_t)1 << s);
  // heights over the plane that held last are not what they were
  p->memo.plane += p->memo.plane > 0;
}

// Settles the items that no plane parts.
static NSVCD__APART nsvcd__outcome nsvcd__settle_items(nsvcd__proof *p,
                                                       nsvcd__search *search) {
  nsvcd__sort_items(p, p->of.kept.items, p->count);
  for (size_t n = 0; n < p->count; n++) {
    const nsvcd__item *item = &p->of.kept.items[n];
    NSVCD__PAUSE(p);
    if (nsvcd__is_spent(p)) return NSVCD__SPENT;
    nsvcd__clip_segment(p, search);
    if (!nsvcd__matters(p, search, item->segment)) continue;
    const int is_clipped = (p->clipped >> item->segment & 1) != 0;
    if (is_clipped && nsvcd__item_is_parted(p, search, item)) continue;
    const nsvcd__outcome outcome = nsvcd__settle_item(p, search, item);
    if (outcome != NSVCD__SETTLED) return outcome;
  }
  p->count = 0;
  return nsvcd__is_spent(p) ? NSVCD__SPENT : NSVCD__SETTLED;
}

// Looks at fresh items: parts those that planes can part, looks for a witness in the others, and
// keeps them. The last plane that held is tried on all before anything else: it often holds for
// neighbours.
static NSVCD__APART nsvcd__outcome nsvcd__sift_items(nsvcd__proof *p, nsvcd__search *search) {
  size_t count = 0;
  nsvcd__clip_segment(p, search);
  for (size_t n = 0; n < p->fresh_count; n++) {
    if (p->memo.plane && nsvcd__held_again(p, search, &p->fresh[n])) continue;
    p->fresh[count++] = p->fresh[n];
  }
  p->fresh_count = 0;
  nsvcd__sort_items(p, p->fresh, count);
  if (count > 0 && p->fresh[0].depth > NSVCD__DEEP &&
      nsvcd__seek_item(p, search, &p->fresh[0]) == NSVCD__ANSWERED)
    return NSVCD__ANSWERED;

  for (size_t n = 0; n < count; n++) {
    nsvcd__item *item = &p->fresh[n];
    NSVCD__PAUSE(p);
    if (nsvcd__is_spent(p)) return NSVCD__SPENT;
    nsvcd__clip_segment(p, search);
    if (!nsvcd__matters(p, search, item->segment)) continue;
    if (p->memo.plane && nsvcd__held_again(p, search, item)) continue;
    if (nsvcd__item_is_parted(p, search, item)) continue;
    double u;
    const uint32_t first = nsvcd__arc_of(p->ask.motion, search->begin[item->segment], &u);
    if (p->ask.first > 0 && nsvcd__is_straight(nsvcd__arc_at(p, first))) {
      const nsvcd__outcome outcome = nsvcd__settle_item(p, search, item);
      if (outcome != NSVCD__SETTLED) return outcome;
      continue;
    }
    if (p->misses >= NSVCD__HOPE) {
      const nsvcd__span *span = nsvcd__segment_span(p, search, item->segment);
      const nsvcd__outcome by_triangles =
          nsvcd__settle_triangles(p, item->moving, item->fixed, span, 0, 0, 0);
      if (by_triangles == NSVCD__SETTLED) continue;
    }
    if (!item->sought && nsvcd__seek_item(p, search, item) == NSVCD__ANSWERED)
      return NSVCD__ANSWERED;
    p->misses++;
    if (p->count == NSVCD__ITEMS) {
      const nsvcd__outcome outcome = nsvcd__settle_items(p, search);
      if (outcome != NSVCD__SETTLED) return outcome;
    }
    p->of.kept.items[p->count++] = *item;
  }
  return NSVCD__SETTLED;
}

// Is there room for touches, and a way out of those that were gathered?
static int nsvcd__gathers_on(const nsvcd__proof *p) {
  return p->touch_count < NSVCD__TOUCHES && !p->too_deep;
}

// Gathers what fresh items touch at the start, or the items where contact points may be. SPENT: as
// much as can be looked at together, or as was allowed.
static nsvcd__outcome nsvcd__gather_items(nsvcd__proof *p, nsvcd__search *search) {
  for (size_t n = 0; n < p->fresh_count && nsvcd__gathers_on(p); n++) {
    const nsvcd__item *item = &p->fresh[n];
    NSVCD__PAUSE(p);
    if (p->memo.plane && nsvcd__held_again(p, search, item)) continue;
    if (nsvcd__item_is_parted(p, search, item)) continue;
    if (p->ask.gathers == NSVCD__TOUCHING) {
      (void)nsvcd__find_witness(p, item->moving, item->fixed, 0, 0);
    } else if (p->count < NSVCD__ITEMS) {
      p->of.kept.items[p->count++] = *item;
    }
  }
  p->fresh_count = 0;
  return nsvcd__gathers_on(p) && p->work <= p->ask.limit ? NSVCD__SETTLED : NSVCD__SPENT;
}

// How far places on both patches of an item, the moving one posed, can at most be along each
// of these directions of a manifold: they are within both hulls.
static void nsvcd__bound_of(const nsvcd__proof *p, const nsvcd__transform *pose,
                            const nsvcd__item *item, int first, int last, float *most) {
  const nsvcd__manifold *m = &p->of.kept.manifold;
  const float scale = p->ask.motion->scale;
  const float moving_more = scale * p->moving.slacks[item->moving] + (float)m->reach;
  const float fixed_more = p->fixed.slacks[item->fixed];
  for (int k = first; k < last; k++) {
    const nsvcd__v3 back = nsvcd__v3_set(nsvcd__d3_narrow(nsvcd__d3_scale(m->along[k], -1)));
    float by_moving = HUGE_VALF;
    float by_fixed = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 moving = nsvcd__hull_of(&p->moving, item->moving, l);
      const nsvcd__v3 fixed = nsvcd__hull_of(&p->fixed, item->fixed, l);
      const nsvcd__v height = nsvcd__v3_dot(back, nsvcd__v3_transform(pose, moving));
      by_moving = nsvcd__least_of(by_moving, nsvcd__v_least(height));
      by_fixed = nsvcd__least_of(by_fixed, nsvcd__v_least(nsvcd__v3_dot(back, fixed)));
    }
    most[k] = fminf(moving_more - by_moving, fixed_more - by_fixed);
  }
}

// The manifold of the items that were gathered, in directions first to last - 1: at first of those
// that may be farthest along one, then of what may still be farther. Where bodies are deep in each
// other there are many, and few of their places are like a contact: so many are looked at, and no
// more.
static NSVCD__APART void nsvcd__seek_places(nsvcd__proof *p, int first, int last) {
  nsvcd__manifold *m = &p->of.kept.manifold;
  nsvcd__item *items = p->of.kept.items;
  const nsvcd__placement at = nsvcd__placement_at(nsvcd__arc_at(p, 0), 0);
  const nsvcd__transform pose = nsvcd__transform_of(&at);
  size_t looks = 0;
  float farthest[NSVCD__SUPPORTS];
  size_t best[NSVCD__SUPPORTS] = {0};
  float most[NSVCD__SUPPORTS];
  for (int k = first; k < last; k++) farthest[k] = -HUGE_VALF;
  for (size_t n = 0; n < p->count; n++) {
    items[n].sought = 0;
    nsvcd__bound_of(p, &pose, &items[n], first, last, most);
    for (int k = first; k < last; k++) {
      if (most[k] > farthest[k]) best[k] = n;
      farthest[k] = fmaxf(farthest[k], most[k]);
    }
  }
  const size_t count = (size_t)(last - first);
  for (size_t n = 0; n < count + p->count && p->count > 0; n++) {
    const size_t which = n < count ? best[(size_t)first + n] : n - count;
    nsvcd__item *item = &items[which];
    int matters = 0;
    nsvcd__bound_of(p, &pose, item, first, last, most);
    for (int k = first; k < last; k++) matters |= (double)most[k] > m->farthest[k] + m->same;
    if (item->sought || !matters) continue;
    if (looks == NSVCD__HOLDS || (looks == NSVCD__HOPE && !(m->farthest[first] > -HUGE_VAL)))
      break;
    item->sought = 1;
    looks++;
    (void)nsvcd__find_witness(p, item->moving, item->fixed, 0, 0);
  }
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------- proof/containment
// In: two bodies that do not touch at a time. Out: is a component of one inside the other? By rays,
// in double.

#ifndef NSVCD_NO_PROOF
// A ray from a place of a body's frame, in that frame: does the body enclose the place?
typedef struct nsvcd__ray {
  nsvcd__d3 from, direction;
  // a ray that passes an edge within this tells nothing; and that, with what rounding may add
  double margin;
  float rounding;
} nsvcd__ray;

// +1 if the ray leaves through the triangle, -1 if it enters, 0 if it misses it; *unclear if it
// passes an edge.
static int nsvcd__ray_crosses(const nsvcd__ray *ray, const nsvcd__d3 *t, double margin,
                              int *unclear) {
  double around[3];
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  double nearest = HUGE_VAL;
  const nsvcd__d3 n = nsvcd__face_normal(t);
  // the signed volumes of the edges and the ray: all alike if it passes within
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    const nsvcd__d3 across = nsvcd__d3_cross(edge, ray->direction);
    const double length = nsvcd__d3_length(across);
    around[k] = nsvcd__d3_dot(across, nsvcd__d3_sub(t[k], ray->from));
    least = nsvcd__min(least, around[k]);
    most = nsvcd__max(most, around[k]);
    nearest = nsvcd__min(nearest, length > 0 ? fabs(around[k]) / length : 0);
  }
  const double slope = nsvcd__d3_dot(n, ray->direction);
  const double height = nsvcd__d3_dot(n, nsvcd__d3_sub(t[0], ray->from));
  const double size = nsvcd__d3_length(n);
  const int behind = height * slope < 0 && fabs(height) > margin * size;
  if (behind) return 0;
  if (nearest <= margin) {
    // Near the line of an edge, but is it near the triangle?
    nsvcd__d3 far_end = nsvcd__d3_add(ray->from, nsvcd__d3_scale(ray->direction, 4 * 1.6e7));
    nsvcd__nearest near_edge = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < 3; k++)
      nsvcd__edges_nearest(ray->from, far_end, t[k], t[(k + 1) % 3], &near_edge);
    if (near_edge.square <= 4 * margin * margin) *unclear = 1;
    if (least < 0 && most > 0) return 0;
  }
  if (least <= 0 && most >= 0) return 0;
  if (fabs(height) <= margin * size) *unclear = 1;
  return slope > 0 ? 1 : slope < 0 ? -1 : 0;
}

// Lanes of 16 spheres, in the body's frame, that the ray meets; a filter of a walk.
static uint32_t nsvcd__is_on_ray(const void *what, nsvcd__spheres all) {
  const nsvcd__ray *ray = (const nsvcd__ray *)what;
  const nsvcd__f3 from = nsvcd__f3_round(ray->from);
  const nsvcd__f3 direction = nsvcd__f3_round(ray->direction);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(all, l);
    const nsvcd__v3 n = nsvcd__v3_set(direction);
    const nsvcd__v3 d = nsvcd__v3_sub(centre, nsvcd__v3_set(from));
    const nsvcd__v3 off = nsvcd__v3_cross(d, n);
    const nsvcd__v reach = nsvcd__v_plus(nsvcd__v_load(all.r + l), ray->rounding);
    const nsvcd__v square = nsvcd__v3_dot(off, off);
    const uint32_t near_line = nsvcd__v_le(square, nsvcd__v_signed_square(reach));
    met |= (near_line & nsvcd__v_le(nsvcd__v_negate(reach), nsvcd__v3_dot(d, n))) << l;
  }
  return met;
}

// Is the triangle new to the list of those that a ray has crossed? Then it is added; *unclear if
// there is no room.
static int nsvcd__is_new(nsvcd__proof *p, size_t *count, uint32_t number, int *unclear) {
  for (size_t k = 0; k < *count; k++) {
    if (p->crossed[k] == number) return 0;
  }
  if (*count == NSVCD__CROSSED) *unclear = 1;
  if (*count < NSVCD__CROSSED) p->crossed[(*count)++] = number;
  return 1;
}

// Lanes of a block whose triangles the ray crosses, or passes within the margin, and some more. The
// signed volumes of the edges and the ray are products of an edge and a place on it, off by no more
// than `rounding`, square metres: see nsvcd__crossings.
static uint32_t nsvcd__lanes_on_ray(nsvcd__block *block, const nsvcd__ray *ray, float margin,
                                    float rounding) {
  const nsvcd__f3 start = nsvcd__f3_round(ray->from);
  const nsvcd__f3 way = nsvcd__f3_round(ray->direction);
  uint32_t missed = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 from = nsvcd__v3_set(start);
    const nsvcd__v3 direction = nsvcd__v3_set(way);
    const nsvcd__v3 a = nsvcd__v3_load(block->corners[0], l);
    const nsvcd__v3 b = nsvcd__v3_load(block->corners[1], l);
    const nsvcd__v3 c = nsvcd__v3_load(block->corners[2], l);
    const nsvcd__v3 ab = nsvcd__v3_cross(nsvcd__v3_sub(b, a), direction);
    const nsvcd__v3 bc = nsvcd__v3_cross(nsvcd__v3_sub(c, b), direction);
    const nsvcd__v3 ca = nsvcd__v3_cross(nsvcd__v3_sub(a, c), direction);
    const nsvcd__v by_ab = nsvcd__v3_dot(ab, nsvcd__v3_sub(a, from));
    const nsvcd__v by_bc = nsvcd__v3_dot(bc, nsvcd__v3_sub(b, from));
    const nsvcd__v by_ca = nsvcd__v3_dot(ca, nsvcd__v3_sub(c, from));
    const nsvcd__v least = nsvcd__v_min(by_ab, nsvcd__v_min(by_bc, by_ca));
    const nsvcd__v most = nsvcd__v_max(by_ab, nsvcd__v_max(by_bc, by_ca));
    const nsvcd__v longer = nsvcd__v_max(nsvcd__v3_length(bc), nsvcd__v3_length(ca));
    const nsvcd__v longest = nsvcd__v_max(nsvcd__v3_length(ab), longer);
    const nsvcd__v allowed =
        nsvcd__v_fma(nsvcd__v_set(margin), longest, nsvcd__v_set(rounding));
    missed |= (nsvcd__v_lt(least, nsvcd__v_negate(allowed)) & nsvcd__v_lt(allowed, most)) << l;
  }
  return nsvcd__block_lanes(block) & ~missed;
}

// How often the surface of the closed components winds about a point, by one ray; *unclear if it
// cannot tell. A triangle counts once, whatever patches list it, or parts of it.
//
// How far are the signed volumes of nsvcd__lanes_on_ray off? With u = 2^-24, E the extent, R that
// and the distance of the ray's place: a corner, a vertex of up to E from a centre of up to E, is
// off by 2 u E. An edge, of up to 2 E, by two corners and its own rounding, 6 u E; its product with
// the direction, rounded as well, by 6 + 2 + 2.31 x 2 (|a_y b_z| + |a_z b_y| and so on are no more
// than 1.155 |a| |b| together) = 12.7 u E. A place on it, up to R from the ray's, by 3 u R. The
// volume then by 12.7 u E R + 2 E x 3 u R, and by 3 roundings of up to 2 E R: 24.7 u E R, less than
// 1.5e-6 E R. NSVCD__ROUNDING is more.
static int nsvcd__crossings(nsvcd__proof *p, const nsvcd__facets *f, const nsvcd__ray *ray,
                            int *unclear) {
  nsvcd__block *block = &p->fixed_blocks[0];
  p->memo.window = 0;
  const float remote = (float)nsvcd__d3_length(ray->from) + f->body->extent;
  const float rounding = NSVCD__ROUNDING * remote * f->body->extent;
  int sum = 0;
  size_t count = 0;
  size_t g;
  nsvcd__walk walk;
  nsvcd__walk_begin(&walk, f->body, nsvcd__is_on_ray, ray);
  while (!*unclear && nsvcd__walk_next(&walk, &g)) {
    const nsvcd__spheres all = nsvcd__body_patches(f->body);
    uint32_t patches = nsvcd__is_on_ray(ray, nsvcd__spheres_from(all, NSVCD__GROUP * g));
    for (; patches && !*unclear; patches &= patches - 1) {
      const size_t i = NSVCD__GROUP * g + nsvcd__low_bit(patches);
      if (i >= f->body->patches) break;
      const double margin = (double)f->quanta[i] + ray->margin;
      const size_t end = f->first_triangle[i + 1];
      nsvcd__numbers numbers = nsvcd__numbers_of(f, i);
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        p->work++;
        uint32_t lanes = nsvcd__lanes_on_ray(block, ray, (float)(2 * margin), rounding);
        for (; lanes; lanes &= lanes - 1) {
          const size_t listing = n + nsvcd__low_bit(lanes);
          nsvcd__d3 corners[3];
          nsvcd__read_number(&numbers, listing);
          if (!numbers.encloses) continue;
          p->work++;
          nsvcd__facet_triangle(f, i, listing, corners);
          const int crossing = nsvcd__ray_crosses(ray, corners, margin, unclear);
          if (crossing && nsvcd__is_new(p, &count, numbers.number, unclear)) sum += crossing;
        }
      }
    }
  }
  return sum;
}

// A place in a body's frame, and a distance from it.
typedef struct nsvcd__surroundings {
  nsvcd__f3 place;
  float distance;
} nsvcd__surroundings;

// Lanes of 16 spheres that come within that; a filter of a walk.
static uint32_t nsvcd__is_around(const void *what, nsvcd__spheres all) {
  const nsvcd__surroundings *here = (const nsvcd__surroundings *)what;
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), nsvcd__v3_set(here->place));
    const nsvcd__v reach = nsvcd__v_plus(nsvcd__v_load(all.r + l), here->distance);
    met |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(reach)) << l;
  }
  return met;
}

// Is a stored triangle so close to the place that the true surface may be on its other side?
static int nsvcd__surface_is_near(nsvcd__proof *p, const nsvcd__facets *f, nsvcd__d3 place,
                                  double tolerance) {
  const nsvcd_body *b = f->body;
  const nsvcd__d3 point[3] = {place, place, place};
  const nsvcd__f3 rounded = nsvcd__f3_round(place);
  const nsvcd__box at = {rounded, rounded};
  const float remote = nsvcd__f3_length(rounded) + b->extent;
  const float distance =
      2 * nsvcd__widest_quantum(f) + (float)tolerance * 1.0001f + 4 * NSVCD__ROUNDING * remote;
  const nsvcd__surroundings here = {rounded, distance};
  nsvcd__block *block = &p->fixed_blocks[0];
  size_t g;
  nsvcd__walk walk;
  p->memo.window = 0;
  nsvcd__walk_begin(&walk, b, nsvcd__is_around, &here);
  while (nsvcd__walk_next(&walk, &g)) {
    const size_t first = NSVCD__GROUP * g;
    const nsvcd__spheres members = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    for (uint32_t met = nsvcd__is_around(&here, members); met; met &= met - 1) {
      const size_t i = first + nsvcd__low_bit(met);
      if (i >= b->patches) break;
      const double limit = 2 * (double)f->quanta[i] + tolerance;
      const size_t end = f->first_triangle[i + 1];
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        p->work++;
        uint32_t lanes = nsvcd__lanes_near(block, at, distance);
        for (; lanes; lanes &= lanes - 1) {
          nsvcd__d3 corners[3];
          nsvcd__facet_triangle(f, i, n + nsvcd__low_bit(lanes), corners);
          if (nsvcd__nearest_of(point, corners).square <= limit * limit) return 1;
        }
      }
    }
  }
  return 0;
}

// Does the body enclose a place of its frame, farther from its surface than rounding? Rays in
// directions that no mesh is likely to be aligned with, the first one on the side of the body on
// which the place is. unit: of its frame.
static int nsvcd__is_enclosed(nsvcd__proof *p, const nsvcd__facets *f, double unit,
                              nsvcd__d3 place) {
  static const double directions[8][3] = {
      {0.5359, 0.6013, 0.5927},   {-0.5741, 0.6229, 0.5314},  {0.6127, -0.5531, 0.5644},
      {-0.5477, -0.5923, 0.5909}, {0.6311, 0.5573, -0.5396},  {-0.6053, 0.5297, -0.5941},
      {0.5623, -0.6217, -0.5452}, {-0.5849, -0.5407, -0.6047}};
  const nsvcd__d3 centre = nsvcd__d3_load(f->body->centre);
  const nsvcd__d3 off = nsvcd__d3_sub(place, centre);
  const double radius = (double)f->body->radius;
  if (f->body->open || nsvcd__d3_dot(off, off) > 1.00001 * radius * radius) return 0;
  const size_t best = (off.x < 0 ? 1u : 0u) + (off.y < 0 ? 2u : 0u) + (off.z < 0 ? 4u : 0u);
  nsvcd__ray ray;
  ray.from = place;
  ray.margin = NSVCD__SAME_PLACE * (double)p->given.lengths / unit;
  ray.rounding = (float)ray.margin + 4 * NSVCD__ROUNDING * f->body->extent;
  for (size_t n = 0; n < 8 && p->work <= p->ask.limit; n++) {
    const double *d = directions[best ^ n];
    int unclear = 0;
    ray.direction = nsvcd__d3_of(d[0], d[1], d[2]);
    ray.direction = nsvcd__d3_scale(ray.direction, 1 / nsvcd__d3_length(ray.direction));
    const int crossings = nsvcd__crossings(p, f, &ray, &unclear);
    if (unclear) continue;
    return crossings != 0;
  }
  p->unclear = 1;
  return 0;
}

// Does some surface of a body lie outside of a sphere about the other? start: from the frame of the
// first to that of the second, in which the first is of this scale.
static int nsvcd__sticks_out(const nsvcd__facets *inner, const nsvcd__transform *start,
                             float scale, const nsvcd_body *outer) {
  const nsvcd_body *b = inner->body;
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_load(outer->centre));
  const float rounding = 4 * NSVCD__ROUNDING * (scale * b->extent + outer->extent);
  const nsvcd__v radius = nsvcd__v_set(outer->radius + rounding);
  for (size_t first = 0; first < b->padded; first += NSVCD__LANES) {
    const nsvcd__spheres patches = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    uint32_t out = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 own = nsvcd__v3_centres(patches, l);
      const nsvcd__v3 posed = nsvcd__v3_transform(start, own);
      const nsvcd__v3 d = nsvcd__v3_sub(posed, centre);
      const nsvcd__v own_radius = nsvcd__v_load(patches.r + l);
      const nsvcd__v limit = nsvcd__v_fma(nsvcd__v_set(scale), own_radius, radius);
      out |= nsvcd__v_lt(nsvcd__v_mul(limit, limit), nsvcd__v3_dot(d, d)) << l;
    }
    for (; out; out &= out - 1) {
      const size_t i = first + nsvcd__low_bit(out);
      if (i < inner->body->patches && inner->hull_counts[i]) return 1;
    }
  }
  return 0;
}

// Seeds first .. first + 15 that may be in the sphere and in the box about the other body.
static uint32_t nsvcd__seeds_near(const nsvcd__facets *inner, size_t first,
                                  const nsvcd__transform *start, float scale,
                                  const nsvcd__facets *outer) {
  const nsvcd_body *o = outer->body;
  const size_t left = inner->components - first;
  float lanes[3][NSVCD__LANES];
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const float *seed = inner->seeds + 3 * (first + (l < left ? l : 0));
    for (size_t k = 0; k < 3; k++) lanes[k][l] = seed[k];
  }
  const nsvcd__f3 centre = nsvcd__f3_of(o->centre[0], o->centre[1], o->centre[2]);
  const float remote =
      nsvcd__f3_length(start->position) + scale * inner->body->extent + o->extent;
  const float rounding = 4 * NSVCD__ROUNDING * remote;
  uint32_t nearby = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 seen = nsvcd__v3_transform(start, nsvcd__v3_load(lanes, l));
    const nsvcd__v3 d = nsvcd__v3_sub(seen, nsvcd__v3_set(centre));
    const nsvcd__v radius = nsvcd__v_set(o->radius + rounding);
    const nsvcd__v at[3] = {seen.x, seen.y, seen.z};
    uint32_t slice = nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_mul(radius, radius));
    for (size_t k = 0; k < 3; k++) {
      slice &= nsvcd__v_le(nsvcd__v_set(outer->box[k] - rounding), at[k]);
      slice &= nsvcd__v_le(at[k], nsvcd__v_set(outer->box[3 + k] + rounding));
    }
    nearby |= slice << l;
  }
  return nearby;
}

// The pose that takes the fixed body's frame to the moving one's, which is of this scale: rows are
// those of the inverse rotation, over it.
static nsvcd__placement nsvcd__inverse_placement(const nsvcd__placement *at, double scale) {
  const double inverse = 1 / (scale * scale);
  nsvcd__placement out;
  const nsvcd__dmat3 transpose = nsvcd__dmat3_transpose(at->rotation);
  out.rotation = nsvcd__dmat3_scale(&transpose, inverse);
  out.position = nsvcd__d3_scale(nsvcd__dmat3_apply(&out.rotation, at->position), -1);
  return out;
}

// One body at the start of the motion, as the other sees it.
typedef struct nsvcd__enclosure {
  const nsvcd__facets *inner, *outer;
  // of the inner body in the outer one's frame, the same rounded, and the other way round
  nsvcd__placement start;
  nsvcd__transform rounded;
  nsvcd__placement back;
  float scale;  // of the inner body, in that frame
  // of that frame: the fixed body's units
  double unit;
  // it is the motion's moving body
  int inner_moves;
} nsvcd__enclosure;

// Are some of the inner body's components, those with seeds from `first` to `end`, within the outer
// one? Then p->enclosed has the point, and p->within is set; 1 if that is certain.
static int nsvcd__encloses_seeds(nsvcd__proof *p, const nsvcd__enclosure *e, size_t first,
                                 size_t end) {
  uint32_t nearby = 0;
  for (size_t n = first; n < end; n++) {
    const size_t l = (n - first) % NSVCD__LANES;
    if (l == 0) nearby = nsvcd__seeds_near(e->inner, n, &e->rounded, e->scale, e->outer);
    if (!(nearby >> l & 1)) continue;
    if (nsvcd__is_spent(p)) {
      p->unclear = 1;
      return 0;
    }
    const nsvcd__d3 seed = nsvcd__d3_load(e->inner->seeds + 3 * n);
    const nsvcd__d3 seen = nsvcd__place_point(&e->start, seed);
    if (!nsvcd__is_enclosed(p, e->outer, e->unit, seen)) continue;
    p->enclosed = e->inner_moves ? seen : seed;
    p->within = 1;
    if (!nsvcd__surface_is_near(p, e->outer, seen, p->given.tolerance / e->unit)) return 1;
  }
  return 0;
}

// The same of all components. Where they are many, only those of groups that come near the outer
// body are asked for.
static int nsvcd__encloses_any(nsvcd__proof *p, const nsvcd__enclosure *e) {
  const nsvcd_body *inner = e->inner->body;
  const nsvcd_body *outer = e->outer->body;
  if (outer->open) return 0;
  if (e->inner->components == 1 && nsvcd__sticks_out(e->inner, &e->rounded, e->scale, outer))
    return 0;
  if (e->inner->components <= NSVCD__LANES)
    return nsvcd__encloses_seeds(p, e, 0, e->inner->components);
  const nsvcd__f3 centre =
      nsvcd__f3_round(nsvcd__place_point(&e->back, nsvcd__d3_load(outer->centre)));
  const float remote = nsvcd__f3_length(centre) + inner->extent + outer->extent / e->scale;
  const nsvcd__surroundings here = {centre,
                                    outer->radius / e->scale + 4 * NSVCD__ROUNDING * remote};
  size_t g;
  nsvcd__walk walk;
  nsvcd__walk_begin(&walk, inner, nsvcd__is_around, &here);
  while (!p->unclear && nsvcd__walk_next(&walk, &g)) {
    if (nsvcd__encloses_seeds(p, e, e->inner->first_seed[g], e->inner->first_seed[g + 1]))
      return 1;
  }
  return 0;
}

// Is a component of one body within the other at the start of the motion? Then p->enclosed is its
// point. Where that is so close to the surface that quanta matter, 0 is returned and p->within is
// set: if planes then part all patches at t = 0, the point, the stored surface and the true one,
// patch by patch on one side of a plane, agree, and it is within.
static NSVCD__APART int nsvcd__starts_within(nsvcd__proof *p) {
  nsvcd__enclosure moving, fixed;
  moving.start = nsvcd__placement_at(nsvcd__arc_at(p, 0), 0);
  moving.back = nsvcd__inverse_placement(&moving.start, p->arc.scale);
  moving.rounded = nsvcd__transform_of(&moving.start);
  moving.inner = fixed.outer = &p->moving;
  moving.outer = fixed.inner = &p->fixed;
  moving.scale = p->ask.motion->scale;
  moving.unit = 1;
  moving.inner_moves = 1;
  fixed.start = moving.back;
  fixed.back = moving.start;
  fixed.rounded = nsvcd__transform_of(&fixed.start);
  fixed.scale = 1 / p->ask.motion->scale;
  fixed.unit = p->arc.scale;
  fixed.inner_moves = 0;
  return nsvcd__encloses_any(p, &moving) || nsvcd__encloses_any(p, &fixed);
}
#endif  // NSVCD_NO_PROOF

// -------------------------------------------------------------------------------------- proof/loop
// In: a question, and a motion that has been cut into segments. Out: all of it settled, or a
// contact that answers the question, or the work spent.

#ifndef NSVCD_NO_PROOF
// Segments that are searched now, and still matter.
static uint64_t nsvcd__segments_that_matter(const nsvcd__proof *p,
                                            const nsvcd__search *search) {
  size_t s = search->segments;
  if (!(p->ask.first > 0) || !p->known.has_contact) return search->wanted;
  while (s > 0 && !nsvcd__matters(p, search, s - 1)) s--;
  return s == 64 ? search->wanted : search->wanted & (((uint64_t)1 << s) - 1);
}

// Adds the items of moving group g and resting patch j in the segments `left`, and clears these, as
// long as there is room for 16 more.
static void nsvcd__collect_items(nsvcd__proof *p, const nsvcd__search *search, size_t g,
                                 size_t j, uint64_t *left) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const nsvcd__f3 place = nsvcd__facet_centre(&p->fixed, j);
  const float radius = nsvcd__body_r(fixed)[j];
  const float *own = nsvcd__body_r(moving) + NSVCD__GROUP * g;
  *left &= nsvcd__segments_that_matter(p, search);
  for (; *left && p->fresh_count + NSVCD__GROUP <= NSVCD__FRESH; *left &= *left - 1) {
    const size_t s = nsvcd__low_bit(*left);
    const nsvcd__chords *c = &search->members[s];
    float squares[NSVCD__LANES];
    float share[NSVCD__LANES];
    uint32_t met = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 start = nsvcd__v3_rows(c->start[0] + l);
      const nsvcd__v3 v = nsvcd__v3_rows(c->way[0] + l);
      const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_set(place));
      const nsvcd__v tau = nsvcd__v_clamp(
          nsvcd__v_mul(nsvcd__v3_dot(d, v), nsvcd__v_load(c->inverse + l)), 0, 1);
      const nsvcd__v3 closest = nsvcd__v3_fma(tau, v, d);
      const nsvcd__v square = nsvcd__v3_dot(closest, closest);
      const nsvcd__v reach = nsvcd__v_plus(nsvcd__v_load(c->reach + l), radius);
      met |= nsvcd__v_le(square, nsvcd__v_signed_square(reach)) << l;
      nsvcd__v_store(squares + l, square);
      nsvcd__v_store(share + l, tau);
    }
    NSVCD__TALLY(tests, 1);
    if (!met) continue;
    const nsvcd__span *span = nsvcd__segment_span(p, search, s);
    met = nsvcd__discs_meet(p, c, g, j, span, search->remote, met);
    for (; met; met &= met - 1) {
      const size_t l = nsvcd__low_bit(met);
      const size_t i = NSVCD__GROUP * g + l;
      if (p->moving.hull_counts[i] == 0) continue;
      const float radii = search->scale * own[l] + radius;
      const float depth = 1 - sqrtf(squares[l]) / (radii > 1e-30f ? radii : 1e-30f);
      const nsvcd__item item = {(uint16_t)i, (uint16_t)j, (uint16_t)s, 0, depth, share[l]};
      p->fresh[p->fresh_count++] = item;
    }
  }
}

// Looks at what the search has found so far.
static nsvcd__outcome nsvcd__see_to_items(nsvcd__proof *p, nsvcd__search *search) {
  return p->ask.gathers ? nsvcd__gather_items(p, search) : nsvcd__sift_items(p, search);
}

// THE LOOP: point 2 of the theorem. A tile's groups, of the moving body and of the resting one, are
// parted by spheres and by discs; of those left, patches by spheres and by discs; what is left of
// these are items, which nsvcd__sift_items and nsvcd__settle_items see to. In the end each pair of
// patches, in each segment that is wanted and still matters, has been parted, or has given a
// contact that answers or shrinks the question, or is a doubt, or was settled by its parts; or
// SPENT says that it has not.
static NSVCD__APART nsvcd__outcome nsvcd__prove_segments(nsvcd__proof *p,
                                                         nsvcd__search *search) {
  nsvcd__outcome outcome;
  for (; search->step < search->steps; search->step++) {
    const size_t next = search->order[search->step];
    const size_t g = search->moving_tile.groups[next];
    nsvcd__search_group(search);
    nsvcd__part_groups(p, search);
    for (; search->waiting; search->waiting &= search->waiting - 1) {
      const size_t at = nsvcd__low_bit(search->waiting);
      const size_t h = search->fixed_tile.groups[at];
      const uint64_t wanted =
          nsvcd__nearby(search, next)[at] & nsvcd__segments_that_matter(p, search);
      uint32_t met = nsvcd__group_against_members(search, h, wanted, p->met_in);
      for (; met; met &= met - 1) {
        const size_t l = nsvcd__low_bit(met);
        uint64_t *left = &p->met_in[l];
        if (p->fixed.hull_counts[NSVCD__GROUP * h + l] == 0) continue;
        for (;;) {
          nsvcd__pose_members(search, g, *left);
          nsvcd__collect_items(p, search, g, NSVCD__GROUP * h + l, left);
          if (!*left) break;
          outcome = nsvcd__see_to_items(p, search);
          if (outcome != NSVCD__SETTLED) return outcome;
        }
      }
      if (p->fresh_count < NSVCD__NEWS) continue;
      outcome = nsvcd__see_to_items(p, search);
      if (outcome != NSVCD__SETTLED) return outcome;
    }
  }
  outcome = nsvcd__see_to_items(p, search);
  if (outcome != NSVCD__SETTLED || p->ask.gathers) return outcome;
  return nsvcd__settle_items(p, search);
}

// Those of the segments from one to another, the last one not included.
static uint64_t nsvcd__segments_in(size_t from, size_t to) {
  const uint64_t before_end = to < 64 ? ((uint64_t)1 << to) - 1 : ~(uint64_t)0;
  return before_end & ~(((uint64_t)1 << from) - 1);
}

// The same of a motion that has been cut: tile after tile. Where the first contact is sought, some
// segments of a tile at a time, until there is a contact: it is the first of the tile. What is
// settled of one tile tells nothing of the others; by time, all tiles are seen to in some segments
// before any in later ones.
static nsvcd__outcome nsvcd__prove_tiles(nsvcd__proof *p, nsvcd__search *search) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const int has_tiles = nsvcd__is_tiled(moving, fixed);
  const size_t few = p->ask.first > 0 ? NSVCD__IN_ORDER : search->segments;
  const size_t many = p->ask.by_time ? few : search->segments;
  nsvcd__outcome outcome = NSVCD__SETTLED;
  for (size_t from = 0; from < search->segments && outcome == NSVCD__SETTLED; from += many) {
    const size_t to = from + many < search->segments ? from + many : search->segments;
    if (!nsvcd__matters(p, search, from)) break;
    (void)nsvcd__search_begin(moving, fixed, nsvcd__segments_in(from, to), search);
    do {
      for (size_t s = from; s < to && outcome == NSVCD__SETTLED; s += few) {
        const size_t next = s + few < to ? s + few : to;
        if (!nsvcd__matters(p, search, s)) break;
        search->wanted = nsvcd__segments_in(s, next);
        search->step = 0;
        search->waiting = 0;
        outcome = nsvcd__prove_segments(p, search);
        if (outcome == NSVCD__SETTLED && !p->known.has_contact && !has_tiles)
          p->known.settled = (double)search->begin[next];
      }
    } while (outcome == NSVCD__SETTLED && nsvcd__search_next_tile(search));
    if (outcome == NSVCD__SETTLED && !p->known.has_contact)
      p->known.settled = (double)search->begin[to];
  }
  return outcome;
}
#endif  // NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- proof/verdict
// In: a question. Out: the verdict; where asked, when they first meet, and how near they come.

#ifndef NSVCD_NO_PROOF
// What is said of a component that is within the other body, whatever contacts were found since.
static nsvcd__verdict nsvcd__is_within(nsvcd__proof *p) {
  memset(&p->known.found, 0, sizeof p->known.found);
  p->known.found.point = p->enclosed;
  p->known.found.moving_triangle = NSVCD_NO_TRIANGLE;
  p->known.found.fixed_triangle = NSVCD_NO_TRIANGLE;
  return NSVCD__WITHIN;
}

// Ticks: nothing meets before this, or NEVER.
static double nsvcd__clear_until(const nsvcd__proof *p) {
  if (p->unclear) return 0;
  return nsvcd__min(nsvcd__min(p->ask.end, p->known.unsure),
                    p->known.lost ? p->known.settled : NSVCD__NEVER);
}

// Makes a proof forget all that it knew of a motion.
static void nsvcd__proof_restart(nsvcd__proof *p) {
  memset(&p->known, 0, sizeof p->known);
  p->ask.end = p->clipped_end = p->known.unsure = NSVCD__NEVER;
  p->ask.doubts_end = 0;
  p->clipped = 0;
  p->arc.ticks = 0;
  p->count = p->fresh_count = p->misses = p->touch_count = 0;
  p->too_deep = 0;
  nsvcd__forget(&p->memo);
}

// Searches a motion whose segments have been chosen, and settles what is found.
static NSVCD__APART nsvcd__outcome nsvcd__prove_motion(nsvcd__proof *p,
                                                       nsvcd__search *search) {
  nsvcd__cut_segments(p->ask.motion, p->given.lengths, nsvcd__clearance(p), search);
  p->ask.first = p->ask.share * (double)p->ask.motion->ticks;
  const nsvcd__outcome outcome = nsvcd__prove_tiles(p, search);
  p->known.lost = outcome == NSVCD__SPENT;
  return outcome;
}

// The same, of any motion, whatever was known of one.
static nsvcd__outcome nsvcd__prove_anew(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, search);
  return nsvcd__prove_motion(p, search);
}

// The pose at the start of a motion, or at its end, as a motion of its own.
static nsvcd__motion nsvcd__end_of(const nsvcd__motion *motion, int at_end) {
  nsvcd__motion still = *motion;
  nsvcd__track moving = motion->moving;
  nsvcd__track fixed = motion->fixed;
  moving.poses += at_end ? moving.count - 1 : 0;
  fixed.poses += at_end ? fixed.count - 1 : 0;
  moving.count = fixed.count = 1;
  moving.times = fixed.times = NULL;
  still.begin = at_end ? 1 : 0;
  still.duration = 0;
  nsvcd__motion_set_tracks(&still, moving, fixed);
  return still;
}

// A look at the start alone, or at the end, which takes so many units at most: do triangles meet
// there? Then that is the contact that is known. If not, all that was known is lost.
static NSVCD__APART int nsvcd__meets_at(nsvcd__proof *p, nsvcd__search *search, int at_end,
                                        size_t units) {
  const nsvcd__asked asked = p->ask;
  nsvcd__motion still = nsvcd__end_of(asked.motion, at_end);
  p->ask.motion = &still;
  p->ask.share = 0;
  p->ask.limit = nsvcd__limit_after(p, units);
  const int meets = nsvcd__prove_anew(p, search) == NSVCD__ANSWERED;
  p->known.found.tick = at_end ? (double)asked.motion->ticks : 0;
  p->ask = asked;
  p->ask.end = 0;
  return meets;
}

// A search whose segments have been chosen. Few questions take long, and of these some are about
// bodies that meet at the start, or the end, and hardly anywhere else: so these are looked at
// before all is searched once more. The end says nothing about a first contact.
static nsvcd__outcome nsvcd__prove_and_look(nsvcd__proof *p, nsvcd__search *search,
                                            size_t limit) {
  p->ask.is_brief = p->work + 4 * NSVCD__LONG < limit;
  p->ask.limit = p->ask.is_brief ? p->work + NSVCD__LONG : limit;
  const nsvcd__outcome outcome = nsvcd__prove_motion(p, search);
  if (outcome != NSVCD__SPENT || !p->ask.is_brief) return outcome;
  p->ask.is_brief = 0;
  // a part of what a doubt leaves has been used
  if (p->known.unsure < NSVCD__NEVER) p->ask.in_doubt -= p->ask.in_doubt / 2;
  if (nsvcd__meets_at(p, search, 0, NSVCD__LOOK)) return NSVCD__ANSWERED;
  if (!(p->ask.share > 0) && nsvcd__meets_at(p, search, 1, NSVCD__LOOK))
    return NSVCD__ANSWERED;
  p->ask.limit = limit;
  return nsvcd__prove_anew(p, search);
}

// There was not work enough for the first contact, and of large bodies nothing is settled then:
// once more, by time.
static NSVCD__APART void nsvcd__prove_by_time(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__known known = p->known;
  const double end = p->ask.end;
  p->ask.by_time = 1;
  p->ask.limit = nsvcd__limit_after(p, p->given.work / (2 * NSVCD__IN_DOUBT));
  (void)nsvcd__prove_anew(p, search);
  p->ask.by_time = 0;
  known.settled = nsvcd__clear_until(p);
  p->known = known;
  p->ask.end = end;
}

// When do they meet first? What is proven of that stays, also where there is no more work left, and
// then it is asked whether they meet at all.
static nsvcd__outcome nsvcd__prove_first(nsvcd__proof *p, nsvcd__search *search) {
  const nsvcd__outcome outcome = nsvcd__prove_and_look(p, search, nsvcd__limit_of_first(p));
  const int is_tiled = nsvcd__is_tiled(p->moving.body, p->fixed.body);
  if (p->known.lost && is_tiled && !(p->known.settled > 0)) nsvcd__prove_by_time(p, search);
  nsvcd__known known = p->known;
  const double end = p->ask.end;
  if (known.has_contact && nsvcd__clear_until(p) <= 0 && known.found.tick > 0) {
    // so early that they may meet at the start already
    if (nsvcd__meets_at(p, search, 0, p->given.work)) return NSVCD__ANSWERED;
    p->starts_free = !p->known.lost && !(p->known.unsure < NSVCD__NEVER);
  } else if (!known.has_contact && (known.lost || known.unsure < NSVCD__NEVER)) {
    const double share = p->ask.share;
    p->ask.share = 0;
    p->ask.limit = p->given.work;
    const nsvcd__outcome any = nsvcd__prove_anew(p, search);
    p->ask.share = share;
    if (any == NSVCD__SETTLED && !(p->known.unsure < NSVCD__NEVER)) return any;
    known.has_contact = p->known.has_contact;
    known.found = p->known.found;
  }
  p->known = known;
  p->ask.end = end;
  return outcome;
}

static nsvcd__verdict nsvcd__prove(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__motion *motion = p->ask.motion;
  const int in_order = p->ask.share > 0;
  const float lifted = nsvcd__f3_length(motion->lift);
  const float apart = p->given.lengths + nsvcd__clearance(p) + 1.0001f * lifted;
  p->ask.limit = p->given.work;
  p->ask.in_doubt = p->given.work / (in_order ? 2 * NSVCD__IN_DOUBT : NSVCD__IN_DOUBT);
  if (nsvcd__motion_gap(motion) > apart) return NSVCD__FREE;
  nsvcd__choose_segments(motion, search);
  if (nsvcd__starts_within(p)) {
    // a hit, whatever else; who asks for more than that is told of triangles, if some meet as well
    const int meets = p->given.tells && nsvcd__meets_at(p, search, 0, NSVCD__GLANCE);
    return meets ? NSVCD__MEETS : nsvcd__is_within(p);
  }
  const nsvcd__outcome outcome = in_order ? nsvcd__prove_first(p, search)
                                          : nsvcd__prove_and_look(p, search, p->given.work);
  const double clear = nsvcd__clear_until(p);
  if (outcome == NSVCD__ANSWERED) return NSVCD__MEETS;
  if (p->within && clear > 0) return nsvcd__is_within(p);
  if (p->known.has_contact) return NSVCD__MEETS;
  if (p->known.unsure < NSVCD__NEVER) p->known.found = p->known.doubt;
  return clear < NSVCD__NEVER ? NSVCD__UNDECIDED : NSVCD__FREE;
}

// ---- the least distance

// Of the patches with a surface, the one whose centre is nearest to a place of the body's frame; of
// a large body one near it, found by going down the levels of spheres, always to the nearest.
static size_t nsvcd__patch_towards(const nsvcd__facets *f, nsvcd__f3 place) {
  const nsvcd_body *body = f->body;
  size_t from = 0;
  size_t count = body->patches;
  size_t patch = 0;
  float least = HUGE_VALF;
  size_t k = nsvcd__is_large(body) ? nsvcd__level_count(body->padded) : 0;
  if (k > 0) count = nsvcd__level_of(body->padded, k - 1).count;
  while (k-- > 0) {
    const nsvcd__level level = nsvcd__level_of(body->padded, k);
    const nsvcd__spheres all =
        nsvcd__spheres_of(nsvcd__body_floats(body, level.first), level.slots);
    size_t nearest = from;
    float best = HUGE_VALF;
    for (size_t n = from; n < from + count && n < level.count; n++) {
      const nsvcd__f3 off = nsvcd__f3_sub(nsvcd__centre_of(all, n), place);
      const float distance = nsvcd__f3_length(off) - all.r[n];
      if (distance >= best) continue;
      best = distance;
      nearest = n;
    }
    from = NSVCD__GROUP * nearest;
    count = NSVCD__GROUP;
  }
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  for (size_t first = from; first < from + count; first += NSVCD__LANES) {
    float squares[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 off =
          nsvcd__v3_sub(nsvcd__v3_centres(patches, first + l), nsvcd__v3_set(place));
      const nsvcd__v square = nsvcd__v3_dot(off, off);
      nearer |= nsvcd__v_lt(square, nsvcd__v_set(least)) << l;
      nsvcd__v_store(squares + l, square);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t n = first + nsvcd__low_bit(nearer);
      if (n >= body->patches || f->hull_counts[n] == 0) continue;
      if (squares[n - first] >= least) continue;
      least = squares[n - first];
      patch = n;
    }
  }
  return patch;
}

// When the sphere of the moving body whose chords are search->group comes nearest to one of the
// fixed body, in ticks, if that is nearer than `gap`, metres, which becomes how near. Returns 1 if
// it is.
static int nsvcd__nearest_tick(const nsvcd__search *search, nsvcd__sphere fixed, float *gap,
                               double *tick) {
  int found = 0;
  for (size_t b = 0; NSVCD__LANES * b < search->segments; b++) {
    const nsvcd__chords *c = &search->group[b];
    float gaps[NSVCD__LANES], share[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 way = nsvcd__chords_way(c, l);
      const nsvcd__v3 d =
          nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(fixed.centre));
      const nsvcd__v tau = nsvcd__v_clamp(
          nsvcd__v_mul(nsvcd__v3_dot(d, way), nsvcd__v_load(c->inverse + l)), 0, 1);
      const nsvcd__v3 off = nsvcd__v3_fma(tau, way, d);
      const nsvcd__v between =
          nsvcd__v_sub(nsvcd__v3_length(off), nsvcd__v_load(c->reach + l));
      nearer |= nsvcd__v_lt(between, nsvcd__v_set(*gap + fixed.radius)) << l;
      nsvcd__v_store(gaps + l, between);
      nsvcd__v_store(share + l, tau);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t l = nsvcd__low_bit(nearer);
      const size_t s = NSVCD__LANES * b + l;
      if (s >= search->segments || !(gaps[l] - fixed.radius < *gap)) continue;
      *gap = gaps[l] - fixed.radius;
      *tick = (double)search->begin[s];
      *tick += (double)share[l] * ((double)search->begin[s + 1] - *tick);
      found = 1;
    }
  }
  return found;
}

// When two groups come nearest, in ticks, and which resting one that is; of large bodies, when the
// bodies do.
static double nsvcd__groups_nearest(const nsvcd__proof *p, nsvcd__search *search,
                                    nsvcd__sphere *resting) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  float gap = HUGE_VALF;
  double tick = 0;
  *resting = nsvcd__body_sphere(fixed);
  if (nsvcd__is_tiled(moving, fixed)) {
    nsvcd__chords_in_all(search, nsvcd__body_sphere(moving));
    (void)nsvcd__nearest_tick(search, *resting, &gap, &tick);
    return tick;
  }
  for (size_t g = 0; g < nsvcd__body_groups(moving); g++) {
    nsvcd__chords_in_all(search, nsvcd__sphere_of(nsvcd__groups_of(moving), g));
    for (size_t h = 0; h < nsvcd__body_groups(fixed); h++) {
      const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(fixed), h);
      if (nsvcd__nearest_tick(search, group, &gap, &tick)) *resting = group;
    }
  }
  return tick;
}

// The least distance between the hulls' vertices of patch i of the moving body and patch j of the
// fixed one.
static double nsvcd__vertices_apart(const nsvcd__proof *p, const nsvcd__transform *pose,
                                    size_t i, size_t j) {
  float lanes[3][NSVCD__LANES];
  float least = HUGE_VALF;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 moving = nsvcd__hull_of(&p->moving, i, l);
    nsvcd__v3_store(lanes, l, nsvcd__v3_transform(pose, moving));
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 fixed = nsvcd__hull_of(&p->fixed, j, l);
    for (size_t n = 0; n < NSVCD__LANES; n++) {
      const nsvcd__v3 d = nsvcd__v3_sub(fixed, nsvcd__v3_set(nsvcd__lane_of(lanes, n)));
      least = nsvcd__least_of(least, nsvcd__v_least(nsvcd__v3_dot(d, d)));
    }
  }
  return sqrt((double)least);
}

// How near the bodies come for certain, and a little more: the least distance between the vertices
// of two patches, when and where these are nearest to each other. They are found in turns: which
// are the nearest at a time, and when they are nearest. Where `measure` begins.
static NSVCD__APART double nsvcd__guess_clearance(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__sphere moving = nsvcd__body_sphere(p->moving.body);
  nsvcd__sphere fixed;
  // they may not have been: bodies that never come near are told apart without
  nsvcd__cut_segments(p->ask.motion, p->given.lengths, 0, search);
  double tick = nsvcd__groups_nearest(p, search, &fixed);
  double least = HUGE_VAL;
  for (size_t turn = 0; turn < NSVCD__TURNS; turn++) {
    double u;
    if (turn > 0) {
      float gap = HUGE_VALF;
      nsvcd__chords_in_all(search, moving);
      (void)nsvcd__nearest_tick(search, fixed, &gap, &tick);
    }
    const uint32_t first = nsvcd__arc_of(p->ask.motion, tick, &u);
    const nsvcd__placement at = nsvcd__placement_at(nsvcd__arc_at(p, first), u);
    const nsvcd__transform pose = nsvcd__transform_of(&at);
    const nsvcd__placement back = nsvcd__inverse_placement(&at, p->arc.scale);
    size_t i = 0;
    size_t j = 0;
    for (size_t round = 0; round < 2; round++) {
      const nsvcd__d3 seen = nsvcd__place_point(&back, nsvcd__d3_widen(fixed.centre));
      i = nsvcd__patch_towards(&p->moving, nsvcd__f3_round(seen));
      moving = nsvcd__sphere_of(nsvcd__body_patches(p->moving.body), i);
      j = nsvcd__patch_towards(&p->fixed, nsvcd__f3_transform(&pose, moving.centre));
      fixed = nsvcd__sphere_of(nsvcd__body_patches(p->fixed.body), j);
    }
    const float lengths = p->given.lengths + nsvcd__f3_length(pose.position);
    const double rounding =
        (double)(4 * NSVCD__ROUNDING * lengths + 2 * nsvcd__quanta_of(p, i, j));
    const double apart = 1.0001 * nsvcd__vertices_apart(p, &pose, i, j) + rounding;
    least = nsvcd__min(least, apart);
  }
  return least;
}

// One pass: a search whose question shrinks, for a bracket as narrow as p->ask.measure. What was
// known stays known, and what is found is added. Returns whether there was work enough.
static int nsvcd__measure_once(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__known known = p->known;
  const int is_named = known.has_contact || known.unsure < NSVCD__NEVER;
  p->ask.clearance = is_named ? nsvcd__max(p->low, p->high - p->ask.measure) : p->high;
  const nsvcd__outcome pass = nsvcd__prove_anew(p, search);
  if (p->known.has_contact) {
    known.has_contact = 1;
    known.found = p->known.found;
  }
  p->known = known;
  if (pass != NSVCD__SPENT) p->low = p->ask.clearance;
  return pass != NSVCD__SPENT;
}

// Brackets the least distance over the motion, when it is known whether they come within the
// clearance that is asked for. Where half of the work is not enough for that, the rest goes to
// brackets that get narrower and narrower: the last one that there was work enough for stays.
static NSVCD__APART void nsvcd__measure(nsvcd__proof *p, nsvcd__search *search,
                                        nsvcd__verdict verdict, double finest) {
  const int is_named = p->known.has_contact || p->known.unsure < NSVCD__NEVER;
  const float lifted = nsvcd__f3_length(p->ask.motion->lift);
  const float gap = nsvcd__motion_gap(p->ask.motion) - p->given.lengths - 1.0001f * lifted;
  p->low = nsvcd__max(verdict == NSVCD__FREE ? p->given.clearance : 0, (double)gap);
  nsvcd__choose_segments(p->ask.motion, search);
  p->high = is_named ? p->known.found.distance : nsvcd__guess_clearance(p, search);
  if (is_named && !(p->high - p->low > finest)) return;
  p->ask.measure = finest;
  p->ask.limit = nsvcd__limit_after(p, p->given.work / 2);
  p->wide = !nsvcd__measure_once(p, search);
  p->ask.limit = p->given.work;
  for (p->ask.measure = p->high - p->low; p->wide && p->ask.measure > finest;) {
    p->ask.measure = nsvcd__max(finest, p->ask.measure / NSVCD__FINER);
    p->wide = nsvcd__measure_once(p, search);
  }
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/leave
// In: a question with a skin. Out: the question about a body lifted off what it touches at the
// start.
//
// What carries a body must not stop it. Which contacts are those? The body is asked about as if it
// were lifted off all that it touches at the start, by a vector v that has the skin's length along
// every normal there. That is a motion like any other, and what is proven of it is proven: the body
// stays clear of everything when displaced by v, so that, undisplaced, it goes no deeper than |v|
// into anything. What presses in deeper than the skin at the start has no such v, nor has what is
// held from opposite sides, and is hit as ever. v is constant as the fixed body sees it.

#ifndef NSVCD_NO_PROOF
// How good a lift along n is: the more touches it undoes the better; of equals, the more of
// these have a face that says so. 0 if it undoes none, or cannot be better than `most`.
static size_t nsvcd__undone(const nsvcd__proof *p, nsvcd__d3 n, size_t most) {
  const size_t each = NSVCD__TOUCHES + 2;
  size_t good = 0;
  for (size_t k = 0; k < p->touch_count; k++) {
    const nsvcd__touch *t = &p->of.touches[k];
    if (good + (p->touch_count - k) * (each + 1) <= most) return 0;
    if (!nsvcd__undoes(p, n, t)) continue;
    good += each;
    good += nsvcd__d3_dot(n, t->ways[0]) > 0.9 || nsvcd__d3_dot(n, t->ways[1]) > 0.9;
  }
  return good;
}

// Takes a direction that is better than the best so far.
static void nsvcd__try_lift(const nsvcd__proof *p, nsvcd__d3 n, size_t *most,
                            nsvcd__d3 *best) {
  if (*most > 0 && nsvcd__d3_dot(n, *best) > 0.99999) return;
  const size_t good = nsvcd__undone(p, n, *most);
  if (good == 0) return;
  *best = n;
  *most = good;
}

// Of the normals of what touches, and the directions across an edge of each, the one that undoes
// the most touches: *best, as it was if none undoes any: then 0 is returned.
static int nsvcd__best_lift(const nsvcd__proof *p, nsvcd__d3 *best) {
  size_t most = 0;
  for (size_t k = 0; k < p->touch_count; k++) {
    for (size_t i = 0; i < 3; i++) nsvcd__try_lift(p, p->of.touches[k].ways[i], &most, best);
  }
  // an edge on an edge
  for (size_t k = 0; k < 9 && !(most > 0); k++) {
    const nsvcd__touch *t = &p->of.touches[0];
    const nsvcd__d3 n = nsvcd__across_edges(t, k);
    const nsvcd__d3 out = nsvcd__d3_add(t->ways[0], t->ways[1]);
    const double side = nsvcd__d3_dot(n, out) < 0 ? -1 : 1;
    nsvcd__try_lift(p, nsvcd__d3_scale(n, side), &most, best);
  }
  return most > 0;
}

// Finds directions that undo all that was gathered. 0: there are none for something, or too many.
static int nsvcd__choose_lifts(nsvcd__proof *p) {
  if (p->too_deep) return 0;
  while (p->touch_count > 0) {
    const size_t k = p->normal_count;
    nsvcd__d3 best = {0, 0, 0};
    if (k == NSVCD__LIFTS || !nsvcd__best_lift(p, &best)) return 0;
    p->normals[k] = best;
    p->depths[k] = 0;
    p->normal_count++;
    size_t left = 0;
    for (size_t n = 0; n < p->touch_count; n++) {
      if (!nsvcd__undone_by(p, k, &p->of.touches[n])) p->of.touches[left++] = p->of.touches[n];
    }
    p->touch_count = left;
  }
  return 1;
}

// The shortest vector, nearly, that has `least`, and as much more as the depths say if these count,
// along all normals that were gathered. 0 if there is none of less than four times the longest.
static nsvcd__d3 nsvcd__lift_off(const nsvcd__proof *p, double least, int by_depth) {
  nsvcd__d3 lift = {0, 0, 0};
  double longest = 0;
  for (size_t round = 0; round < 64; round++) {
    double most = 0;
    for (size_t k = 0; k < p->normal_count; k++) {
      const double along = least + (by_depth ? p->depths[k] : 0);
      const double lacks = along - nsvcd__d3_dot(lift, p->normals[k]);
      longest = nsvcd__max(longest, along);
      most = nsvcd__max(most, lacks);
      if (lacks > 0) lift = nsvcd__d3_add(lift, nsvcd__d3_scale(p->normals[k], lacks));
    }
    if (nsvcd__d3_length(lift) > 4 * longest) break;
    if (most <= 0.005 * longest) return lift;
  }
  return nsvcd__d3_of(0, 0, 0);
}

// The two bodies' widest quanta: nearer to each other than this nothing is parted.
static double nsvcd__hair(const nsvcd__proof *p) {
  const float moving = p->ask.motion->scale * nsvcd__widest_quantum(&p->moving);
  return (double)(moving + nsvcd__widest_quantum(&p->fixed));
}

// Lifts what rests off what it touches: by nothing at first, and whenever something touches when so
// lifted, by more, until nothing does. Triangles smaller than the skin can be parted along a wall
// that others of them stay in touch with, and there may be too many touches to look at together: so
// what has been found is tried. If there is no way off all that was found, then what was found
// first may have been the wrong way, and is forgotten, once. Returns 0 if there is no way off.
static int nsvcd__lift_still(nsvcd__proof *p, nsvcd__search *search, nsvcd__motion *still) {
  p->normal_count = 0;
  still->lift = nsvcd__f3_of(0, 0, 0);
  // what is about to touch, or where a motion may have ended before, is lifted off too; and may not
  // touch afterwards
  double beside = nsvcd__max(0.05 * p->ask.skin, nsvcd__min(p->given.to, 0.5 * p->ask.skin));
  for (int turns = 0;; beside = 0.01 * p->ask.skin) {
    p->ask.clearance = p->given.clearance + beside + nsvcd__hair(p);
    (void)nsvcd__prove_anew(p, search);
    if (p->touch_count == 0) return 1;
    const size_t known = p->normal_count;
    if (!nsvcd__choose_lifts(p) || p->normal_count == known) return 0;
    nsvcd__d3 lift = nsvcd__lift_off(p, p->ask.skin, 0);
    if (!(nsvcd__d3_dot(lift, lift) > 0) && turns++ == 0) {
      memmove(p->normals, p->normals + 1, --p->normal_count * sizeof *p->normals);
      memmove(p->depths, p->depths + 1, p->normal_count * sizeof *p->depths);
      lift = nsvcd__lift_off(p, p->ask.skin, 0);
    }
    if (!(nsvcd__d3_dot(lift, lift) > 0)) return 0;
    still->lift = nsvcd__f3_round(lift);
  }
}

// The normal along which a touch is undone first, by planes normal to it.
static size_t nsvcd__way_of(const nsvcd__proof *p, const nsvcd__touch *t) {
  size_t best = 0;
  double least = HUGE_VAL;
  for (size_t k = 0; k < p->normal_count; k++) {
    const double way = nsvcd__lift_along(p->normals[k], t);
    if (way < least) best = k;
    least = nsvcd__min(least, way);
  }
  return best;
}

// What is not in touch at the start may be where the body is lifted to, and there may have been too
// many touches: so it is lifted by no more than the depths that are known, to see what it touches
// there, until it touches nothing.
static void nsvcd__deepen(nsvcd__proof *p, nsvcd__search *search, nsvcd__motion *still) {
  const nsvcd__f3 lift = still->lift;
  p->ask.clearance = p->given.clearance;
  for (int round = 0; round < NSVCD__DEEPEN; round++) {
    const nsvcd__d3 least = nsvcd__lift_off(p, 0.5 * nsvcd__hair(p), 1);
    double before = 0;
    double after = 0;
    for (size_t k = 0; k < p->normal_count; k++) before += p->depths[k];
    still->lift = nsvcd__f3_round(least);
    (void)nsvcd__prove_anew(p, search);
    // what no plane normal to a lift parts is out of the way after it all the same
    for (size_t n = 0; n < p->touch_count; n++)
      nsvcd__note_depth(p, nsvcd__way_of(p, &p->of.touches[n]), &p->of.touches[n]);
    for (size_t k = 0; k < p->normal_count; k++) after += p->depths[k];
    if (!(after > 1.002 * before)) break;
  }
  still->lift = lift;
}

// Lifts the motion off what it touches at its start, by the skin. Where something is in the way of
// that, and nothing is too deep, by what is needed.
static NSVCD__APART void nsvcd__lift_motion(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__motion *whole = p->ask.motion;
  nsvcd__motion start = nsvcd__end_of(whole, 0);
  p->ask.motion = &start;
  p->ask.gathers = NSVCD__TOUCHING;
  p->ask.skin = p->given.skin;
  p->needed = 0;
  int is_free = nsvcd__lift_still(p, search, &start);
  const double least = 1.1 * p->needed + 4 * nsvcd__hair(p);
  if (!is_free && p->touch_count == 0 && least < 0.9 * p->given.skin) {
    p->ask.skin = least;
    is_free = nsvcd__lift_still(p, search, &start);
  }
  if (is_free && p->normal_count > 0) nsvcd__deepen(p, search, &start);
  p->ask.gathers = NSVCD__CONTACTS;
  p->ask.clearance = p->given.clearance;
  p->ask.motion = whole;
  whole->lift = is_free ? start.lift : nsvcd__f3_of(0, 0, 0);
  nsvcd__proof_restart(p);
}
#endif  // NSVCD_NO_PROOF

// ============================================================================= network: an opinion

// ------------------------------------------------------------------------- network/latent_rotation
// In: a rotation, and a latent. Out: the latent, turned.
//
// D(R), block-diagonal: R itself on degree 1, the real Wigner matrix of degree 2 on degree 2
// (NeuralSVCD, appendix E). Computed from R directly, so D(R1 R2) = D(R1) D(R2) to rounding; R may
// be improper (a mirror): both degrees are polynomial.

#ifndef NSVCD_NO_NETWORK
// numbers of a latent's vectors: (3, CHANNELS), then (5, CHANNELS)
#define NSVCD__VECTORS (8 * NSVCD_W_CHANNELS)
// numbers of D: (3, 3), then (5, 5)
#define NSVCD__WIGNER 34
// of a stored latent's numbers
#define NSVCD__LATENT_STEP (1.0f / 127)

// The degree 2 of the symmetric product of a and b, lane by lane: q (5), as nsvcd__degree2.
static void nsvcd__v_degree2(nsvcd__v3 a, nsvcd__v3 b, nsvcd__v *q) {
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__v half_root3 = nsvcd__v_set(0.8660254037844386f);
  const nsvcd__v xx = nsvcd__v_mul(a.x, b.x);
  const nsvcd__v yy = nsvcd__v_mul(a.y, b.y);
  const nsvcd__v zz = nsvcd__v_mul(a.z, b.z);
  const nsvcd__v xy = nsvcd__v_fma(a.x, b.y, nsvcd__v_mul(a.y, b.x));
  const nsvcd__v yz = nsvcd__v_fma(a.y, b.z, nsvcd__v_mul(a.z, b.y));
  const nsvcd__v xz = nsvcd__v_fma(a.x, b.z, nsvcd__v_mul(a.z, b.x));
  q[0] = nsvcd__v_mul(half_root3, xy);
  q[1] = nsvcd__v_mul(half_root3, yz);
  q[2] = nsvcd__v_sub(zz, nsvcd__v_mul(half, nsvcd__v_fma(a.x, b.x, yy)));
  q[3] = nsvcd__v_mul(half_root3, xz);
  q[4] = nsvcd__v_mul(half_root3, nsvcd__v_sub(xx, yy));
}

// D of a slice of matrices, lane by lane, times `scale`: out (WIGNER, SLICE). Column k of degree 2
// is the image of basis vector k, a degree 2 of m's columns.
static NSVCD__APART void nsvcd__wigner(const nsvcd__vmat3 *m, nsvcd__v scale,
                                       float (*out)[NSVCD__SLICE]) {
  const nsvcd__v third = nsvcd__v_scale(scale, 1.0f / 3);
  const nsvcd__v root = nsvcd__v_scale(scale, 0.5773502691896258f);
  const nsvcd__v twice = nsvcd__v_add(root, root);
  const nsvcd__vmat3 columns = nsvcd__vmat3_transpose(*m);
  nsvcd__v xy[5], yz[5], xz[5], xx[5], yy[5], zz[5];
  nsvcd__v3_store_rows(nsvcd__v3_scale(m->x, scale), out[0], NSVCD__SLICE);
  nsvcd__v3_store_rows(nsvcd__v3_scale(m->y, scale), out[3], NSVCD__SLICE);
  nsvcd__v3_store_rows(nsvcd__v3_scale(m->z, scale), out[6], NSVCD__SLICE);
  nsvcd__v_degree2(columns.x, columns.y, xy);
  nsvcd__v_degree2(columns.y, columns.z, yz);
  nsvcd__v_degree2(columns.x, columns.z, xz);
  nsvcd__v_degree2(columns.x, columns.x, xx);
  nsvcd__v_degree2(columns.y, columns.y, yy);
  nsvcd__v_degree2(columns.z, columns.z, zz);
  for (size_t k = 0; k < 5; k++) {
    float(*row)[NSVCD__SLICE] = out + 9 + 5 * k;
    const nsvcd__v rest = nsvcd__v_add(xx[k], yy[k]);
    const nsvcd__v upright = nsvcd__v_sub(nsvcd__v_add(zz[k], zz[k]), rest);
    nsvcd__v_store(row[0], nsvcd__v_mul(twice, xy[k]));
    nsvcd__v_store(row[1], nsvcd__v_mul(twice, yz[k]));
    nsvcd__v_store(row[2], nsvcd__v_mul(third, upright));
    nsvcd__v_store(row[3], nsvcd__v_mul(twice, xz[k]));
    nsvcd__v_store(row[4], nsvcd__v_mul(root, nsvcd__v_sub(xx[k], yy[k])));
  }
}

// One degree: out (size, CHANNELS) = D (size * size, SLICE) of lane l times latent (size,
// CHANNELS).
NSVCD__INLINE void nsvcd__rotate_degree(const float *latent, float (*turn)[NSVCD__SLICE],
                                        size_t l, size_t size, float *out) {
  for (size_t i = 0; i < size; i++) {
    float sum[NSVCD_W_CHANNELS] = {0};
    for (size_t k = 0; k < size; k++) {
      const float m = turn[size * i + k][l];
      for (size_t c = 0; c < NSVCD_W_CHANNELS; c++)
        sum[c] += m * latent[NSVCD_W_CHANNELS * k + c];
    }
    memcpy(out + NSVCD_W_CHANNELS * i, sum, sizeof sum);
  }
}

// Turns a stored latent by D (WIGNER, SLICE) of lane l, and writes it to place 0 or 1 of a row of
// the decoder's inputs: vectors (2, 8, CHANNELS), then scalars (2, SCALARS).
static NSVCD__APART void nsvcd__rotate_latent(const int8_t *z, float (*turn)[NSVCD__SLICE],
                                              size_t l, size_t place, float *row) {
  float *vectors = row + NSVCD__VECTORS * place;
  float *scalars = row + 2 * NSVCD__VECTORS + NSVCD_W_SCALARS * place;
  // one after the other: it is the deepest place of a query
  float degree[5 * NSVCD_W_CHANNELS];
  for (size_t k = 0; k < 3 * NSVCD_W_CHANNELS; k++) degree[k] = (float)z[k];
  nsvcd__rotate_degree(degree, turn, l, 3, vectors);
  z += 3 * NSVCD_W_CHANNELS;
  for (size_t k = 0; k < 5 * NSVCD_W_CHANNELS; k++) degree[k] = (float)z[k];
  nsvcd__rotate_degree(degree, turn + 9, l, 5, vectors + 3 * NSVCD_W_CHANNELS);
  z += 5 * NSVCD_W_CHANNELS;
  for (size_t k = 0; k < NSVCD_W_SCALARS; k++) scalars[k] = (float)z[k] * NSVCD__LATENT_STEP;
}
#endif  // NSVCD_NO_NETWORK

// -------------------------------------------------------------------------- network/winding_number
// In: two bodies and a pose. Out: is one inside the other? A body wholly inside another never
// crosses its surface, so surfaces cannot tell. The winding number of a closed surface can
// (Jacobson et al. 2013), and far from the surface each patch is as good as a dipole of its area
// vector (Barill et al. 2018):
//   w(x) = sum_i A_i . (p_i - x) / (4 pi |p_i - x|^3)     1 inside, 0 outside
// Near the surface it is not: a flat disc seen from its covering radius gives 0.25 where 0.146 is
// true, from half of it 1.0 where 0.28 is true. So the place asked about is the patch centre of the
// inner body (of NSVCD__PLACES) that is farthest from the outer patches in units of their radii,
// and below NSVCD__FAR_ENOUGH the answer is no: then it lies in a covering sphere, the broad phase
// has candidates, and the network is asked. Measured at a million places about spheres of 32 to 512
// patches, the worst error of w is 0.55 from 0.75 radii on, 0.52 from 1, 0.06 from 1.5; from 1 on,
// fewer than 1 in 1,000 exceed 0.3.
// In bodies of more than a tile's patches the sums of area vectors stand for those of whole groups,
// and of what is above them, where the place is farther than NSVCD__DIPOLE of their spheres' radii:
// w is then within 0.05 of the sum over all patches (tests/test_level.c).
// Cost: at most NSVCD__PLACES * N distances each way, where one body's centres lie in the other's
// sphere; of large bodies only those of groups nearby.

#ifndef NSVCD_NO_NETWORK
// places of the inner body that are looked at
#define NSVCD__PLACES NSVCD__LANES
// Distances, in radii. A place is far enough if no patch is nearer than this,
#define NSVCD__FAR_ENOUGH 1.0f
// it needs no more than this, and what is farther away is not looked at;
#define NSVCD__AMPLE 2.0f
// and the patches of a sphere that is farther than this count as one
#define NSVCD__DIPOLE 3.0f

// A filter of a walk: spheres whose members may be nearer to one of the places than NSVCD__AMPLE of
// their radii. A member (p, r) of a sphere (c, R) has |p - c| + r <= R, so that |p - x| / r is at
// least |c - x| / R.
static uint32_t nsvcd__may_be_close(const void *what, nsvcd__spheres all) {
  const nsvcd__sphere *places = (const nsvcd__sphere *)what;
  const nsvcd__v radius = nsvcd__v_set(places->radius);
  uint32_t close = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_set(places->centre);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), centre);
    const nsvcd__v r = nsvcd__v_load(all.r + l);
    const nsvcd__v ample = nsvcd__v_fma(r, nsvcd__v_set(NSVCD__AMPLE), radius);
    close |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(ample)) << l;
  }
  return close;
}

// Least |p_i - x| / r_i, squared, over the patches of a body, at places (3, PLACES); NSVCD__AMPLE,
// squared, is the most it says. out: (PLACES).
static void nsvcd__squares_in_radii(const nsvcd_body *body, float (*places)[NSVCD__PLACES],
                                    float *out) {
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  nsvcd__f3 low = nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF);
  nsvcd__f3 high = nsvcd__f3_scale(low, -1);
  nsvcd__walk walk;
  size_t g;
  for (size_t k = 0; k < NSVCD__PLACES; k++) {
    low = nsvcd__f3_min(low, nsvcd__lane_of(places, k));
    high = nsvcd__f3_max(high, nsvcd__lane_of(places, k));
    out[k] = NSVCD__AMPLE * NSVCD__AMPLE;
  }
  nsvcd__sphere over;  // all places
  over.centre = nsvcd__f3_add(nsvcd__f3_scale(low, 0.5f), nsvcd__f3_scale(high, 0.5f));
  over.radius = nsvcd__f3_length(nsvcd__f3_sub(high, over.centre));
  nsvcd__walk_begin(&walk, body, nsvcd__may_be_close, &over);
  while (nsvcd__walk_next(&walk, &g)) {
    const size_t next = NSVCD__GROUP * (g + 1);
    const size_t end = next < body->patches ? next : body->patches;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 place = nsvcd__v3_load(places, l);
      nsvcd__v least = nsvcd__v_load(out + l);
      for (size_t i = NSVCD__GROUP * g; i < end; i++) {
        const nsvcd__sphere patch = nsvcd__sphere_of(patches, i);
        const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_set(patch.centre), place);
        const float square = patch.radius * patch.radius;
        const float inverse = 1 / (square > 1e-37f ? square : 1e-37f);
        least = nsvcd__v_min(least, nsvcd__v_scale(nsvcd__v3_dot(d, d), inverse));
      }
      nsvcd__v_store(out + l, least);
    }
  }
}

// Adds the terms of the winding number of so many spheres, a multiple of 16, from `first` on, lane
// by lane. n: 0 of patches, else of level n - 1, 64 at most: those that are too close to the point
// leave that to their members.
static void nsvcd__add_dipoles(const nsvcd_body *body, size_t n, size_t first, size_t count,
                               nsvcd__f3 point, float *lanes) {
  const nsvcd__v3 at = nsvcd__v3_set(point);
  nsvcd__spheres spheres = nsvcd__body_patches(body);
  const float *areas = nsvcd__body_areas(body);
  size_t stride = body->padded;
  uint64_t close = 0;
  if (n > 0) {
    const nsvcd__level level = nsvcd__level_of(body->padded, n - 1);
    spheres = nsvcd__level_spheres(body, level);
    areas = nsvcd__level_areas(body, level);
    stride = level.slots;
  }
  spheres = nsvcd__spheres_from(spheres, first);
  NSVCD__EACH_SLICE(l) {
    nsvcd__v sum = nsvcd__v_load(lanes + l);
    for (size_t i = l; i < count; i += NSVCD__LANES) {
      const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(spheres, i), at);
      const nsvcd__v3 area = nsvcd__v3_load_rows(areas + first + i, stride);
      const nsvcd__v length = nsvcd__v_max(nsvcd__v3_length(d), nsvcd__v_set(1e-30f));
      const nsvcd__v inverse = nsvcd__v_div(nsvcd__v_set(1), length);
      // step by step: the cube may overflow
      const nsvcd__v cosine = nsvcd__v_mul(nsvcd__v3_dot(area, d), inverse);
      nsvcd__v term = nsvcd__v_mul(nsvcd__v_mul(cosine, inverse), inverse);
      if (n > 0) {
        const nsvcd__v radius = nsvcd__v_load(spheres.r + i);
        const nsvcd__v least = nsvcd__v_scale(radius, NSVCD__DIPOLE);
        close |= (uint64_t)nsvcd__v_le(length, least) << i;
        term = nsvcd__v_pick(length, least, nsvcd__v_set(0), term);
      }
      sum = nsvcd__v_add(sum, term);
    }
    nsvcd__v_store(lanes + l, sum);
  }
  for (; close; close &= close - 1) {
    const size_t member = NSVCD__GROUP * (first + nsvcd__low_bit(close));
    nsvcd__add_dipoles(body, n - 1, member, NSVCD__GROUP, point, lanes);
  }
}

static float nsvcd__winding_number(const nsvcd_body *body, nsvcd__f3 point) {
  float lanes[NSVCD__LANES] = {0};
  float total = 0;
  const size_t top = nsvcd__level_count(body->padded) - 1;
  const size_t slots = nsvcd__level_of(body->padded, top).slots;
  if (top > 0)
    nsvcd__add_dipoles(body, top + 1, 0, slots, point, lanes);
  else
    nsvcd__add_dipoles(body, 0, 0, body->padded, point, lanes);
  // in this order, whatever the slices
  for (size_t l = 0; l < NSVCD__LANES; l++) total += lanes[l];
  return total / 12.5663706f;
}

// 1 if `inner`, of this scale and at this pose in the frame of `outer`, lies inside it.
static int nsvcd__is_inside(const nsvcd_body *inner, const nsvcd_body *outer, float scale,
                            const nsvcd__transform *pose) {
  const nsvcd__spheres patches = nsvcd__body_patches(inner);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_load(outer->centre));
  float places[3][NSVCD__PLACES];
  float squares[NSVCD__PLACES];
  uint32_t within = 0;
  size_t best = 0;
  if (outer->open) return 0;
  for (size_t k = 0; k < NSVCD__PLACES; k++) {
    // neighbours are stored together: equal steps spread over it
    const nsvcd__f3 own = nsvcd__centre_of(patches, k * inner->patches / NSVCD__PLACES);
    const nsvcd__f3 turned = nsvcd__mat3_apply(&pose->rotation, own);
    const nsvcd__f3 place = nsvcd__f3_add(nsvcd__f3_scale(turned, scale), pose->position);
    nsvcd__lane_set(place, places, k);
  }
  // One that sticks out of the outer body's sphere says it all.
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 off = nsvcd__v3_sub(nsvcd__v3_load(places, l), centre);
    within |= nsvcd__v_le(nsvcd__v3_length(off), nsvcd__v_set(outer->radius)) << l;
  }
  if (within != 0xffff) return 0;
  nsvcd__squares_in_radii(outer, places, squares);
  for (size_t k = 1; k < NSVCD__PLACES; k++) best = squares[k] > squares[best] ? k : best;
  if (squares[best] < NSVCD__FAR_ENOUGH * NSVCD__FAR_ENOUGH) return 0;
  // -1 where the mesh is inside out
  return fabsf(nsvcd__winding_number(outer, nsvcd__lane_of(places, best))) > 0.5f;
}

// 1 if one body lies inside the other, whichever, when the moving one, of this scale, is at this
// pose in the fixed frame.
static int nsvcd__is_contained(const nsvcd_body *moving, const nsvcd_body *fixed, float scale,
                               const nsvcd__transform *pose) {
  nsvcd__transform back;
  back.rotation = nsvcd__mat3_transpose(pose->rotation);
  const nsvcd__f3 from = nsvcd__mat3_apply(&back.rotation, pose->position);
  back.position = nsvcd__f3_of(-from.x / scale, -from.y / scale, -from.z / scale);
  return nsvcd__is_inside(moving, fixed, scale, pose) ||
         nsvcd__is_inside(fixed, moving, 1 / scale, &back);
}
#endif  // NSVCD_NO_NETWORK

// ----------------------------------------------------------------------------------- network/pairs
// In: candidate pairs of patches and the motion over the intervals in which their balls meet.
// Out: their invariants (n, DECODER_IN), of which the decoder makes a logit each.
//
// The motion is linearised about the middle of the interval; then everything is expressed in a
// frame that moves with the pair, in units of r1 + r2 (NeuralSVCD, appendix F), so the logit is
// invariant to rigid motion and scale. The symmetries that are left are removed by convention, not
// learned:
//   swap           the larger patch comes first
//   axis 1         the line between the centres
//   axis 2         the velocity across the line, plus a twentieth of the lean (the difference of
//                  the patches' mean directions, latent channel 0), so that it has a limit where
//                  the velocity vanishes
//   time reversal  time runs so that velocity and lean, across the line, do not oppose each other
//   mirror         axis 3 points to the side of the lean; where the lean is on neither side, as it
//                  is for a pair at rest, the frame is right-handed
// Degenerate cases: centres that coincide (to 1e-5 of r1 + r2) take the lean, else x, as axis 1; a
// reference that vanishes takes the coordinate axis farthest from axis 1 as axis 2.
//
// Pairs are asked about in batches of 16, at most. They become inputs a slice at a time, one per
// lane (only their latents are turned pair by pair, channels side by side), and these go through
// the layers some rows at a time.

#ifndef NSVCD_NO_NETWORK
#define NSVCD__BATCH NSVCD__LANES
// Rows of inputs at a time, and the step in which the layers of floats go through them: where there
// are no vectors, there may be no stack for more, and without floats nothing is gained by more than
// one.
#if NSVCD__SLICE > 1
#define NSVCD__ROWS NSVCD__BATCH
#define NSVCD__ROW_STEP 4
#elif !defined(NSVCD_NO_FLOAT)
#define NSVCD__ROWS 4
#define NSVCD__ROW_STEP 4
#else
#define NSVCD__ROWS 1
#define NSVCD__ROW_STEP 1
#endif
// What the decoder sees of a pair's geometry, in the pair's frame and units; vectors take three
// numbers.
enum {
  // of the centres
  NSVCD__FACT_DISTANCE = 0,
  NSVCD__FACT_RADIUS = 1,   // the larger one
  NSVCD__FACT_CLOSEST = 2,  // distance of the centres, when they come closest,
  NSVCD__FACT_TAU = 3,      // and when that is: -1 and 1 are the ends of the interval
  NSVCD__FACT_VELOCITY = 4,
  NSVCD__FACT_TURN = 7,
  NSVCD__FACT_SPEED = 10,  // the lengths of these two
  NSVCD__FACT_SPIN = 11,
  NSVCD__FACTS = 12
};
#define NSVCD__INPUTS (2 * NSVCD__LATENT + NSVCD__FACTS)
#define NSVCD__DECODER_IN ((NSVCD__INPUTS + 15) / 16 * 16)  // zeros at the end
// Most outputs of a layer, of the heads that are compiled; the tests hold them against weights.h.
#define NSVCD__WIDEST_TINY 32
#define NSVCD__WIDEST_SMALL 96
#ifndef NSVCD_NO_BASE
#define NSVCD__WIDEST NSVCD_W_WIDEST
#elif !defined(NSVCD_NO_SMALL)
#define NSVCD__WIDEST NSVCD__WIDEST_SMALL
#else
#define NSVCD__WIDEST NSVCD__WIDEST_TINY
#endif
// of a layer
#define NSVCD__MOST_INPUTS \
  (NSVCD__WIDEST > NSVCD__DECODER_IN ? NSVCD__WIDEST : NSVCD__DECODER_IN)
#define NSVCD__LEAN 0.05f  // share of the lean in axis 2
#define NSVCD__SIDE 1e-4f  // a lean less than this to one side of axes 1 and 2 is on neither

// ---- pairs, as they move

// A slice of pairs.
typedef struct nsvcd__pairs {
  // centres at mid-interval: of the moving patch, of the fixed one; the fixed body's frame
  nsvcd__v3 p1, p2;
  // the balls' radii
  nsvcd__v r1, r2;
  nsvcd__vmat3 rotation;  // of the moving body at mid-interval
  // half displacement of the point midway between p1 and p2, as part of the moving body
  nsvcd__v3 v;
  nsvcd__v3 w;  // half rotation vector
  // latents, in the bodies' frames
  const int8_t *z[2][NSVCD__SLICE];
} nsvcd__pairs;

// Half the rotation vector of a unit quaternion, from the sine s of half the angle: asin(s) / s
// times its vector part.
static nsvcd__v3 nsvcd__v_half_rotation(nsvcd__vquat q) {
  // of asin(s) / s by s^2, from its end, to 2e-6 for s < 0.5
  static const float series[5] = {0.03038194f, 0.04464286f, 0.075f, 0.16666667f, 1};
  const nsvcd__v3 axis = nsvcd__vquat_axis(q);
  const nsvcd__v sign = nsvcd__v_sign(q.w);
  const nsvcd__v square = nsvcd__v3_dot(axis, axis);
  nsvcd__v ratio = nsvcd__v_set(0.02237216f);
  for (size_t k = 0; k < 5; k++) ratio = nsvcd__v_fma(ratio, square, nsvcd__v_set(series[k]));
  // over 60 degrees: a motion of few poses
  uint32_t wide = nsvcd__v_le(nsvcd__v_set(0.25f), square);
  if (wide) {
    float ratios[NSVCD__SLICE];
    float squares[NSVCD__SLICE];
    float cosines[NSVCD__SLICE];
    nsvcd__v_store(ratios, ratio);
    nsvcd__v_store(squares, square);
    nsvcd__v_store(cosines, nsvcd__v_mul(sign, q.w));
    for (; wide; wide &= wide - 1) {
      const size_t l = nsvcd__low_bit(wide);
      const float sine = sqrtf(squares[l]);
      ratios[l] = atan2f(sine, cosines[l]) / sine;
    }
    ratio = nsvcd__v_load(ratios);
  }
  return nsvcd__v3_scale(axis, nsvcd__v_mul(sign, ratio));
}

// A track's poses at `count` times t in [0,1], 1 to SLICE, one per lane: unit quaternions, and
// positions from an origin.
static nsvcd__v_pose nsvcd__track_poses_at(const nsvcd__track *track, const float *t,
                                           size_t count, nsvcd__f3 origin) {
  float share[NSVCD__SLICE] = {0};
  float rotation[4 * NSVCD__SLICE] = {0};
  float turned[4 * NSVCD__SLICE] = {0};
  float position[3 * NSVCD__SLICE] = {0};
  float moved[3 * NSVCD__SLICE] = {0};
  const int moves = track->count > 1;
  for (size_t l = count; l < NSVCD__SLICE; l++) rotation[3 * NSVCD__SLICE + l] = 1;
  for (size_t l = 0; l < count; l++) {
    const size_t k = moves ? nsvcd__pose_at(track, t[l], &share[l]) : 0;
    const nsvcd_pose *a = &track->poses[k];
    const nsvcd_pose *b = moves ? a + 1 : a;
    const nsvcd__f3 from = nsvcd__f3_load(a->position);
    const nsvcd__f3 to = nsvcd__f3_load(b->position);
    nsvcd__quat q = nsvcd__quat_load(a->rotation);
    const nsvcd__quat next = nsvcd__quat_load(b->rotation);
    const float cosine = nsvcd__quat_dot(q, next);
    const float sign = cosine < 0 ? -1.0f : 1.0f;
    const nsvcd__quat chord = {sign * next.x - q.x, sign * next.y - q.y, sign * next.z - q.z,
                               sign * next.w - q.w};
    // Within 5 degrees the straight line, brought back to unit length, is the slerp to 2e-6
    // radians.
    if (fabsf(cosine) < 0.999f)
      q = nsvcd__quat_slerp(q, next, share[l]);
    else
      nsvcd__quat_put(chord, turned + l, NSVCD__SLICE);
    nsvcd__quat_put(q, rotation + l, NSVCD__SLICE);
    nsvcd__f3_put(nsvcd__f3_sub(from, origin), position + l, NSVCD__SLICE);
    nsvcd__f3_put(nsvcd__f3_sub(to, from), moved + l, NSVCD__SLICE);
  }
  const nsvcd__v u = nsvcd__v_load(share);
  const nsvcd__vquat start = nsvcd__vquat_load(rotation, NSVCD__SLICE);
  const nsvcd__vquat chord = nsvcd__vquat_load(turned, NSVCD__SLICE);
  const nsvcd__v3 way = nsvcd__v3_load_rows(moved, NSVCD__SLICE);
  nsvcd__v_pose out;
  out.rotation = nsvcd__vquat_unit(nsvcd__vquat_fma(u, chord, start));
  out.position = nsvcd__v3_fma(u, way, nsvcd__v3_load_rows(position, NSVCD__SLICE));
  return out;
}

// The moving body's poses in the fixed frame at `count` times, 1 to SLICE, one per lane.
static nsvcd__v_pose nsvcd__v_poses_at(const nsvcd__motion *motion, const float *t,
                                       size_t count) {
  const nsvcd__f3 origin = motion->fixed_position;
  nsvcd__v_pose pose = nsvcd__track_poses_at(&motion->moving, t, count, origin);
  nsvcd__v_poses at = {pose.rotation, pose.rotation, pose.position};
  if (motion->fixed_moves) {
    pose = nsvcd__track_poses_at(&motion->fixed, t, count, origin);
    at.fixed = pose.rotation;
    at.offset = nsvcd__v3_sub(at.offset, pose.position);
  }
  return nsvcd__v_seen(motion, &at);
}

// Pairs whose moving patches have the given centres, (3, SLICE), from poses at entry, at exit, and
// halfway: where they pass each other, and how they move then. Apart from nsvcd__pairs_of, so that
// its stack does not lie below the poses'.
static NSVCD__APART void nsvcd__pairs_in_passing(const nsvcd__v_pose *at, const float *centres,
                                                 nsvcd__pairs *pairs) {
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__v3 centre = nsvcd__v3_load_rows(centres, NSVCD__SLICE);
  const nsvcd__v3 arm1 = nsvcd__vmat3_apply(nsvcd__vmat3_of(at[0].rotation), centre);
  const nsvcd__v3 arm2 = nsvcd__vmat3_apply(nsvcd__vmat3_of(at[1].rotation), centre);
  const nsvcd__v3 moved = nsvcd__v3_sub(at[1].position, at[0].position);
  const nsvcd__v3 step = nsvcd__v3_add(nsvcd__v3_sub(arm2, arm1), moved);
  const nsvcd__vquat back = nsvcd__vquat_inverse(at[0].rotation);
  pairs->w = nsvcd__v_half_rotation(nsvcd__vquat_mul(at[1].rotation, back));
  pairs->rotation = nsvcd__vmat3_of(at[2].rotation);
  const nsvcd__v3 turned = nsvcd__vmat3_apply(pairs->rotation, centre);
  pairs->p1 = nsvcd__v3_add(turned, at[2].position);
  const nsvcd__v3 arm = nsvcd__v3_scale(nsvcd__v3_sub(pairs->p2, pairs->p1), half);
  pairs->v = nsvcd__v3_fma(half, step, nsvcd__v3_cross(pairs->w, arm));
}

// The pairs of `count` candidates, 1 to SLICE. What is in the lanes beyond does not matter.
static NSVCD__APART void nsvcd__pairs_of(const nsvcd_body *moving, const nsvcd_body *fixed,
                                         const nsvcd__motion *motion,
                                         nsvcd__candidate *const *candidates, size_t count,
                                         nsvcd__pairs *pairs) {
  // of entry, of exit, and halfway
  float times[3][NSVCD__SLICE];
  nsvcd__v_pose at[3];
  float centres[2][3 * NSVCD__SLICE] = {{0}, {0}};
  float radii[2][NSVCD__SLICE] = {{0}, {0}};
  for (size_t l = 0; l < count; l++) {
    const nsvcd__candidate *candidate = candidates[l];
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_body *body = n == 0 ? moving : fixed;
      const size_t i = n == 0 ? candidate->moving : candidate->fixed;
      const float scale = n == 0 ? motion->scale : 1;
      const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(body), i);
      nsvcd__f3_put(nsvcd__f3_scale(patch.centre, scale), centres[n] + l, NSVCD__SLICE);
      radii[n][l] = scale * patch.radius;
      pairs->z[n][l] = nsvcd__body_latents(body) + NSVCD__LATENT * i;
    }
    times[0][l] = candidate->t_enter;
    times[1][l] = candidate->t_exit;
    times[2][l] = 0.5f * (candidate->t_enter + candidate->t_exit);
  }
  pairs->p2 = nsvcd__v3_load_rows(centres[1], NSVCD__SLICE);
  pairs->r1 = nsvcd__v_load(radii[0]);
  pairs->r2 = nsvcd__v_load(radii[1]);
  for (size_t k = 0; k < 3; k++) at[k] = nsvcd__v_poses_at(motion, times[k], count);
  nsvcd__pairs_in_passing(at, centres[0], pairs);
}

// ---- frames and facts

// Pairs in their own units, in the fixed body's axes, and their frames.
typedef struct nsvcd__views {
  // 1 over the unit of length; the radii
  nsvcd__v inverse, k1, k2;
  // -1: the other patch is the larger
  nsvcd__v swap;
  // the line from the larger patch to the smaller one
  nsvcd__v3 d;
  nsvcd__v3 lean;
  // reversed where time is to run backwards
  nsvcd__v3 v, w;
  // rows are its axes in the fixed body's frame
  nsvcd__vmat3 frame;
  // -1 where mirrored, else 1
  nsvcd__v side;
} nsvcd__views;

// Removes from a its part along the unit vector e.
static nsvcd__v3 nsvcd__v_across(nsvcd__v3 a, nsvcd__v3 e) {
  return nsvcd__v3_fma(nsvcd__v_negate(nsvcd__v3_dot(a, e)), e, a);
}

// a over its length, where that exceeds `least`; elsewhere `instead`.
static nsvcd__v3 nsvcd__v_unit_or(nsvcd__v3 a, float least, nsvcd__v3 instead) {
  const nsvcd__v length = nsvcd__v3_length(a);
  const nsvcd__v floor = nsvcd__v_set(least);
  const nsvcd__v inverse = nsvcd__v_div(nsvcd__v_set(1), nsvcd__v_max(length, floor));
  const nsvcd__v3 unit = nsvcd__v3_scale(a, inverse);
  return nsvcd__v3_of(nsvcd__v_pick(length, floor, instead.x, unit.x),
                      nsvcd__v_pick(length, floor, instead.y, unit.y),
                      nsvcd__v_pick(length, floor, instead.z, unit.z));
}

// The mean direction of a stored latent, channel 0 of degree 1, in steps of 1/127.
static nsvcd__f3 nsvcd__mean_direction(const int8_t *z) {
  return nsvcd__f3_of((float)z[0], (float)z[NSVCD_W_CHANNELS], (float)z[2 * NSVCD_W_CHANNELS]);
}

// Views of the first `count` pairs of a slice.
static void nsvcd__views_of(const nsvcd__pairs *pairs, size_t count, nsvcd__views *view) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v minus = nsvcd__v_set(-1);
  const nsvcd__v step = nsvcd__v_set(NSVCD__LATENT_STEP);
  float means[2][3 * NSVCD__SLICE] = {{0}, {0}};
  for (size_t n = 0; n < 2; n++) {
    for (size_t l = 0; l < count; l++)
      nsvcd__f3_put(nsvcd__mean_direction(pairs->z[n][l]), means[n] + l, NSVCD__SLICE);
  }
  const nsvcd__v3 own1 = nsvcd__v3_scale(nsvcd__v3_load_rows(means[0], NSVCD__SLICE), step);
  const nsvcd__v3 mean2 = nsvcd__v3_scale(nsvcd__v3_load_rows(means[1], NSVCD__SLICE), step);
  const nsvcd__v3 mean1 = nsvcd__vmat3_apply(pairs->rotation, own1);
  const nsvcd__v3 between = nsvcd__v3_sub(pairs->p2, pairs->p1);
  // The unit of length: r1 + r2; for points without extent whatever keeps the inputs finite.
  const nsvcd__v lengths = nsvcd__v_add(nsvcd__v3_length(between), nsvcd__v3_length(pairs->v));
  const nsvcd__v least = nsvcd__v_fma(nsvcd__v_set(1e-6f), lengths, nsvcd__v_set(1e-30f));
  const nsvcd__v unit = nsvcd__v_max(nsvcd__v_add(pairs->r1, pairs->r2), least);
  const nsvcd__v inverse = nsvcd__v_div(one, unit);
  view->inverse = inverse;
  view->k1 = nsvcd__v_mul(pairs->r1, inverse);
  view->k2 = nsvcd__v_mul(pairs->r2, inverse);
  view->swap = nsvcd__v_pick(pairs->r2, pairs->r1, one, minus);
  // Seen from the other body the motion is reversed as well, but time may run either way: v and w
  // can stay.
  const nsvcd__v3 lean1 = nsvcd__v3_scale(mean1, view->k1);
  const nsvcd__v3 lean2 = nsvcd__v3_scale(mean2, view->k2);
  const nsvcd__v3 lean = nsvcd__v3_scale(nsvcd__v3_sub(lean1, lean2), view->swap);
  const nsvcd__v3 v = nsvcd__v3_scale(pairs->v, inverse);
  view->lean = lean;
  view->d = nsvcd__v3_scale(nsvcd__v3_scale(between, inverse), view->swap);

  // The frames, and which way time runs.
  const nsvcd__v3 x_axis = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v3 line = nsvcd__v3_of(nsvcd__v_plus(lean.x, 1e-6f), lean.y, lean.z);
  nsvcd__v3 instead = nsvcd__v_unit_or(line, 1e-9f, x_axis);
  const nsvcd__v3 e1 = nsvcd__v_unit_or(view->d, 1e-5f, instead);
  const nsvcd__v3 lean_across = nsvcd__v_across(lean, e1);
  const nsvcd__v3 v_across = nsvcd__v_across(v, e1);
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__v3_dot(lean_across, v_across));
  view->v = nsvcd__v3_scale(v, sign);
  view->w = nsvcd__v3_scale(pairs->w, sign);
  const nsvcd__v3 forward = nsvcd__v3_scale(v_across, sign);
  const nsvcd__v3 ref = nsvcd__v3_fma(nsvcd__v_set(NSVCD__LEAN), lean_across, forward);
  // where the reference vanishes in some lane: the coordinate axis farthest from e1
  if (nsvcd__v_le(nsvcd__v3_length(ref), nsvcd__v_set(1e-7f))) {
    const nsvcd__v3 size = nsvcd__v3_max(e1, nsvcd__v3_negate(e1));
    const nsvcd__v x = nsvcd__v_pick(size.x, nsvcd__v_min(size.y, size.z), one, zero);
    const nsvcd__v y_of_two = nsvcd__v_pick(size.y, size.z, one, zero);
    const nsvcd__v y = nsvcd__v_mul(nsvcd__v_sub(one, x), y_of_two);
    const nsvcd__v3 axis = nsvcd__v3_of(x, y, nsvcd__v_sub(one, nsvcd__v_add(x, y)));
    instead = nsvcd__v_unit_or(nsvcd__v_across(axis, e1), 1e-9f, x_axis);
  }
  const nsvcd__v3 e2 = nsvcd__v_unit_or(ref, 1e-7f, instead);
  const nsvcd__v3 e3 = nsvcd__v3_cross(e1, e2);
  const nsvcd__v beside = nsvcd__v3_dot(lean, e3);
  view->side = nsvcd__v_pick(nsvcd__v_set(-NSVCD__SIDE), beside, one, minus);
  view->frame.x = e1;
  view->frame.y = e2;
  view->frame.z = nsvcd__v3_scale(e3, view->side);
}

// What the decoder sees of a slice of pairs, besides the latents, which it sees turned.
typedef struct nsvcd__scenes {
  // of the moving patches and of the fixed ones: from their bodies' frames to the pairs', and their
  // radii, in units of the pairs' lengths
  nsvcd__vmat3 turn[2];
  nsvcd__v k[2];
  // lanes in which the first patch is the larger
  uint32_t keep;
  float facts[NSVCD__FACTS][NSVCD__SLICE];
} nsvcd__scenes;

// Scenes of the first `count` pairs of a slice.
static NSVCD__APART void nsvcd__scenes_of(const nsvcd__pairs *pairs, size_t count,
                                          nsvcd__scenes *scene) {
  nsvcd__views view;
  nsvcd__views_of(pairs, count, &view);
  scene->turn[0] = nsvcd__vmat3_mul(view.frame, pairs->rotation);
  scene->turn[1] = view.frame;
  scene->k[0] = view.k1;
  scene->k[1] = view.k2;
  scene->keep = nsvcd__v_le(nsvcd__v_set(0), view.swap);

  const nsvcd__v speed2 = nsvcd__v3_dot(view.v, view.v);
  const nsvcd__v above = nsvcd__v_plus(speed2, 1e-6f);
  // nearest approach of the centres, in half intervals
  const nsvcd__v nearest = nsvcd__v_div(nsvcd__v3_dot(view.d, view.v), above);
  const nsvcd__v tau = nsvcd__v_clamp(nearest, -1, 1);
  const nsvcd__v3 closest = nsvcd__v3_sub(view.d, nsvcd__v3_scale(view.v, tau));
  const nsvcd__v3 velocity = nsvcd__vmat3_apply(view.frame, view.v);
  const nsvcd__v3 turn = nsvcd__vmat3_apply(view.frame, view.w);
  // an axial vector
  const nsvcd__v3 mirrored = nsvcd__v3_scale(turn, view.side);

  float(*facts)[NSVCD__SLICE] = scene->facts;
  nsvcd__v_store(facts[NSVCD__FACT_DISTANCE], nsvcd__v3_length(view.d));
  nsvcd__v_store(facts[NSVCD__FACT_RADIUS], nsvcd__v_max(view.k1, view.k2));
  nsvcd__v_store(facts[NSVCD__FACT_CLOSEST], nsvcd__v3_length(closest));
  nsvcd__v_store(facts[NSVCD__FACT_TAU], tau);
  nsvcd__v3_store_rows(velocity, facts[NSVCD__FACT_VELOCITY], NSVCD__SLICE);
  nsvcd__v3_store_rows(mirrored, facts[NSVCD__FACT_TURN], NSVCD__SLICE);
  nsvcd__v_store(facts[NSVCD__FACT_SPEED], nsvcd__v_sqrt(speed2));
  nsvcd__v_store(facts[NSVCD__FACT_SPIN], nsvcd__v3_length(view.w));
}

// The inputs of the decoder (appendix F) for the first `count` pairs of a slice, x (count,
// DECODER_IN): vectors of the larger patch and of the other, their scalars, and the facts.
static NSVCD__APART void nsvcd__inputs_in(const nsvcd__scenes *scene,
                                          const nsvcd__pairs *pairs, size_t count, float *x) {
  const nsvcd__v step = nsvcd__v_set(NSVCD__LATENT_STEP);
  float wigner[NSVCD__WIGNER][NSVCD__SLICE];
  for (size_t n = 0; n < 2; n++) {
    nsvcd__wigner(&scene->turn[n], nsvcd__v_mul(scene->k[n], step), wigner);
    for (size_t l = 0; l < count; l++) {
      const size_t place = (scene->keep >> l & 1) == n;
      nsvcd__rotate_latent(pairs->z[n][l], wigner, l, place, x + NSVCD__DECODER_IN * l);
    }
  }
  for (size_t l = 0; l < count; l++) {
    float *facts = x + NSVCD__DECODER_IN * l + 2 * NSVCD__LATENT;
    for (size_t k = 0; k < NSVCD__DECODER_IN - 2 * NSVCD__LATENT; k++)
      facts[k] = k < NSVCD__FACTS ? scene->facts[k][l] : 0;
  }
}

static NSVCD__APART void nsvcd__invariants(const nsvcd__pairs *pairs, size_t count, float *x) {
  nsvcd__scenes scene;
  nsvcd__scenes_of(pairs, count, &scene);
  nsvcd__inputs_in(&scene, pairs, count, x);
}
#endif  // NSVCD_NO_NETWORK

// --------------------------------------------------------------------------------- network/decoder
// In: invariants of pairs (n, DECODER_IN). Out: a logit each.

#ifndef NSVCD_NO_NETWORK
// Where a layer's numbers lie: y = w^T x + bias, then ReLU but for the last layer.
typedef struct nsvcd__layer {
  size_t inputs, outputs;  // multiples of 4, and of 16
  // in nsvcd_w_decoder, (inputs, outputs), and in nsvcd_w_decoder_int8
  size_t weights;
  // of its outputs, in nsvcd_w_decoder_bias, _scale and _sum
  size_t first;
  int relu;
} nsvcd__layer;

// The n-th layer of a decoder.
static nsvcd__layer nsvcd__layer_of(const nsvcd__decoder *decoder, size_t n) {
  const size_t *sizes = decoder->sizes;
  nsvcd__layer out;
  out.inputs = sizes[n];
  out.outputs = sizes[n + 1];
  out.weights = decoder->weights;
  out.first = decoder->outputs;
  out.relu = n + 1 < decoder->layers;
  for (size_t k = 0; k < n; k++) {
    out.weights += sizes[k] * sizes[k + 1];
    out.first += sizes[k + 1];
  }
  return out;
}

#ifndef NSVCD_NO_FLOAT
// Outputs o .. o + tiles * SLICE - 1 of a layer for so many rows: x, of which a row begins every
// `pitch` floats, and y (rows, WIDEST). rows * tiles sums must fit into the registers.
NSVCD__INLINE void nsvcd__layer_tile(const nsvcd__layer *layer, size_t o, const float *x,
                                     size_t pitch, float *y, size_t rows, size_t tiles) {
  const size_t inputs = layer->inputs;
  const size_t outputs = layer->outputs;
  const int relu = layer->relu;
  const float *w = nsvcd_w_decoder + layer->weights + o;
  const float *bias = nsvcd_w_decoder_bias + layer->first + o;
  nsvcd__v sum[8][4], column[4];
  NSVCD__UNROLL
  for (size_t p = 0; p < rows; p++) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) sum[p][t] = nsvcd__v_load(bias + NSVCD__SLICE * t);
  }
  for (size_t i = 0; i < inputs; i++, w += outputs) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) column[t] = nsvcd__v_load(w + NSVCD__SLICE * t);
    NSVCD__UNROLL
    for (size_t p = 0; p < rows; p++) {
      const nsvcd__v input = nsvcd__v_set(x[pitch * p + i]);
      NSVCD__UNROLL
      for (size_t t = 0; t < tiles; t++) sum[p][t] = nsvcd__v_fma(input, column[t], sum[p][t]);
    }
  }
  NSVCD__UNROLL
  for (size_t p = 0; p < rows; p++) {
    float *row = y + NSVCD__WIDEST * p + o;
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) {
      const nsvcd__v value = relu ? nsvcd__v_max(sum[p][t], nsvcd__v_set(0)) : sum[p][t];
      nsvcd__v_store(row + NSVCD__SLICE * t, value);
    }
  }
}

// As nsvcd__decoder_logits, in fp32. The weights of the largest decoder do not fit into the first
// cache, so the more rows at a time the better: 8 by 2 or 4 by 4 sums in 32 registers, 4 by 16
// outputs, or by 4 slices where that is less, in fewer.
#define NSVCD__TILES (NSVCD__LANES / NSVCD__SLICE < 4 ? NSVCD__LANES / NSVCD__SLICE : 4)
static NSVCD__APART void nsvcd__decoder_by_floats(const nsvcd__decoder *decoder,
                                                  const float *x, size_t count,
                                                  float *logits) {
  const size_t rows = nsvcd__round_up(count, NSVCD__ROW_STEP);
  float a[NSVCD__ROWS * NSVCD__WIDEST];
  float b[NSVCD__ROWS * NSVCD__WIDEST];
  float *y = a;
  size_t pitch = NSVCD__DECODER_IN;
  for (size_t n = 0; n < decoder->layers; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    const size_t outputs = layer.outputs;
    size_t p = 0;
    size_t o;
#if NSVCD__SLICE == 16
    for (; p + 8 <= rows; p += 8) {
      const float *from = x + pitch * p;
      float *to = y + NSVCD__WIDEST * p;
      for (o = 0; o + 32 <= outputs; o += 32)
        nsvcd__layer_tile(&layer, o, from, pitch, to, 8, 2);
      if (o < outputs) nsvcd__layer_tile(&layer, o, from, pitch, to, 8, 1);
    }
#endif
    for (; p < rows; p += 4) {
      const float *from = x + pitch * p;
      float *to = y + NSVCD__WIDEST * p;
#if NSVCD__SLICE == 16
      for (o = 0; o + 64 <= outputs; o += 64)
        nsvcd__layer_tile(&layer, o, from, pitch, to, 4, 4);
      for (; o + 32 <= outputs; o += 32) nsvcd__layer_tile(&layer, o, from, pitch, to, 4, 2);
      if (o < outputs) nsvcd__layer_tile(&layer, o, from, pitch, to, 4, 1);
#else
      for (o = 0; o < outputs; o += NSVCD__TILES * NSVCD__SLICE)
        nsvcd__layer_tile(&layer, o, from, pitch, to, 4, NSVCD__TILES);
#endif
    }
    x = y;
    pitch = NSVCD__WIDEST;
    y = y == a ? b : a;
  }
  for (size_t p = 0; p < count; p++) logits[p] = x[pitch * p];
}
#endif  // NSVCD_NO_FLOAT

#ifndef NSVCD_NO_INT8
// nsvcd__layer_by_bytes is a layer in integers, for BYTE_ROWS rows, which share the weights that
// are loaded: x, of which a row begins every `pitch` floats, and y (BYTE_ROWS, WIDEST), which may
// take x's place. Inputs over the largest of them are bytes in [1, 255] about 128, because the
// processors' instructions multiply unsigned by signed bytes, by weights of (inputs / 4, outputs,
// 4); sums are exact in int32, and 128 times the sum of the weights too much.
#ifdef NSVCD__VNNI
#define NSVCD__BYTE_ROWS 4
// Outputs o .. o + 16 tiles - 1 of bytes (4, inputs): dot (4, outputs).
NSVCD__INLINE void nsvcd__dot_tile(const nsvcd__layer *layer, size_t o, const uint8_t *bytes,
                                   int32_t *dot, size_t tiles) {
  const size_t inputs = layer->inputs;
  const size_t outputs = layer->outputs;
  const int8_t *w = nsvcd_w_decoder_int8 + layer->weights + 4 * o;
  __m512i sum[4][4];
  NSVCD__UNROLL
  for (size_t p = 0; p < 4; p++) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) sum[p][t] = _mm512_setzero_si512();
  }
  for (size_t i = 0; i < inputs; i += 4, w += 4 * outputs) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++) {
      const __m512i column = _mm512_loadu_si512((const void *)(w + 64 * t));
      NSVCD__UNROLL
      for (size_t p = 0; p < 4; p++) {
        int32_t word;
        memcpy(&word, bytes + inputs * p + i, sizeof word);
        sum[p][t] = _mm512_dpbusd_epi32(sum[p][t], _mm512_set1_epi32(word), column);
      }
    }
  }
  NSVCD__UNROLL
  for (size_t p = 0; p < 4; p++) {
    NSVCD__UNROLL
    for (size_t t = 0; t < tiles; t++)
      _mm512_storeu_si512((void *)(dot + outputs * p + o + 16 * t), sum[p][t]);
  }
}
static void nsvcd__layer_by_bytes(const nsvcd__layer *layer, const float *x, size_t pitch,
                                  float *y) {
  const size_t outputs = layer->outputs;
  const float *weights = nsvcd_w_decoder_sum + layer->first;
  const float *scale = nsvcd_w_decoder_scale + layer->first;
  const float *bias = nsvcd_w_decoder_bias + layer->first;
  uint8_t bytes[NSVCD__BYTE_ROWS * NSVCD__MOST_INPUTS];
  int32_t dot[NSVCD__BYTE_ROWS * NSVCD__WIDEST];
  float step[NSVCD__BYTE_ROWS];
  for (size_t p = 0; p < NSVCD__BYTE_ROWS; p++) {
    const float *row = x + pitch * p;
    uint8_t *to = bytes + layer->inputs * p;
    __m512 most = _mm512_set1_ps(1e-20f);
    for (size_t i = 0; i < layer->inputs; i += 16)
      most = nsvcd__v_max(most, _mm512_abs_ps(_mm512_loadu_ps(row + i)));
    const float largest = 0 - nsvcd__v_least(nsvcd__v_sub(nsvcd__v_set(0), most));
    const __m512 inverse = _mm512_set1_ps(127 / largest);
    const __m512 middle = _mm512_set1_ps(128.5f);
    for (size_t i = 0; i < layer->inputs; i += 16) {
      const __m512 scaled = _mm512_fmadd_ps(_mm512_loadu_ps(row + i), inverse, middle);
      const __m512i value = _mm512_maskz_cvttps_epi32(NSVCD__ALL, scaled);
      const __m128i narrow = _mm512_maskz_cvtepi32_epi8(NSVCD__ALL, value);
      _mm_storeu_si128((__m128i *)(void *)(to + i), narrow);
    }
    step[p] = largest / 127;
  }
  size_t o = 0;
  for (; o + 64 <= outputs; o += 64) nsvcd__dot_tile(layer, o, bytes, dot, 4);
  for (; o + 32 <= outputs; o += 32) nsvcd__dot_tile(layer, o, bytes, dot, 2);
  if (o < outputs) nsvcd__dot_tile(layer, o, bytes, dot, 1);
  const __m512 least = _mm512_set1_ps(layer->relu ? 0 : -1e30f);
  const __m512 middle = _mm512_set1_ps(-128);
  for (size_t p = 0; p < NSVCD__BYTE_ROWS; p++) {
    const __m512 steps = _mm512_set1_ps(step[p]);
    for (o = 0; o < outputs; o += 16) {
      const __m512i whole = _mm512_loadu_si512((const void *)(dot + outputs * p + o));
      const __m512 value = _mm512_maskz_cvtepi32_ps(NSVCD__ALL, whole);
      const __m512 exact = _mm512_fmadd_ps(_mm512_loadu_ps(weights + o), middle, value);
      const __m512 factor = _mm512_mul_ps(steps, _mm512_loadu_ps(scale + o));
      const __m512 out = _mm512_fmadd_ps(exact, factor, _mm512_loadu_ps(bias + o));
      _mm512_storeu_ps(y + NSVCD__WIDEST * p + o, nsvcd__v_max(least, out));
    }
  }
}
#else
#define NSVCD__BYTE_ROWS 1
static void nsvcd__layer_by_bytes(const nsvcd__layer *layer, const float *x, size_t pitch,
                                  float *y) {
  const size_t inputs = layer->inputs;
  const size_t outputs = layer->outputs;
  const int8_t *w = nsvcd_w_decoder_int8 + layer->weights;
  const float *weights = nsvcd_w_decoder_sum + layer->first;
  const float *scale = nsvcd_w_decoder_scale + layer->first;
  const float *bias = nsvcd_w_decoder_bias + layer->first;
  uint8_t bytes[NSVCD__MOST_INPUTS];
  int32_t dot[NSVCD__WIDEST];
  float most = 1e-20f;
  (void)pitch;
  for (size_t i = 0; i < inputs; i++) most = fabsf(x[i]) > most ? fabsf(x[i]) : most;
  const float inverse = 127 / most;
  const float step = most / 127;
  for (size_t i = 0; i < inputs; i++) bytes[i] = (uint8_t)(int32_t)(x[i] * inverse + 128.5f);
  memset(dot, 0, outputs * sizeof *dot);
  for (size_t i = 0; i < inputs; i += 4, w += 4 * outputs) {
    const int32_t x0 = bytes[i];
    const int32_t x1 = bytes[i + 1];
    const int32_t x2 = bytes[i + 2];
    const int32_t x3 = bytes[i + 3];
    for (size_t o = 0; o < outputs; o++) {
      dot[o] += (x0 * w[4 * o] + x1 * w[4 * o + 1]) + (x2 * w[4 * o + 2] + x3 * w[4 * o + 3]);
    }
  }
  for (size_t o = 0; o < outputs; o++) {
    const float exact = (float)dot[o] - 128 * weights[o];
    const float value = bias[o] + exact * (step * scale[o]);
    y[o] = layer->relu && value < 0 ? 0 : value;
  }
}
#endif

// As nsvcd__decoder_logits, in int8 arithmetic.
static NSVCD__APART void nsvcd__decoder_by_bytes(const nsvcd__decoder *decoder, const float *x,
                                                 size_t count, float *logits) {
  float y[NSVCD__ROWS * NSVCD__WIDEST];
  size_t pitch = NSVCD__DECODER_IN;
  for (size_t n = 0; n < decoder->layers; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    for (size_t p = 0; p < count; p += NSVCD__BYTE_ROWS)
      nsvcd__layer_by_bytes(&layer, x + pitch * p, pitch, y + NSVCD__WIDEST * p);
    x = y;
    pitch = NSVCD__WIDEST;
  }
  for (size_t p = 0; p < count; p++) logits[p] = x[pitch * p];
}
#endif  // NSVCD_NO_INT8

// x (ROWS, DECODER_IN) -> the logits of the first `count` pairs by a decoder, in fp32 or int8
// arithmetic. Some rows at a time: x must hold numbers up to a multiple of ROW_STEP.
static void nsvcd__decoder_logits(const nsvcd__decoder *decoder, const float *x, size_t count,
                                  int int8, float *logits) {
#ifdef NSVCD_NO_INT8
  (void)int8;
  nsvcd__decoder_by_floats(decoder, x, count, logits);
#elif defined(NSVCD_NO_FLOAT)
  (void)int8;
  nsvcd__decoder_by_bytes(decoder, x, count, logits);
#else
  if (int8)
    nsvcd__decoder_by_bytes(decoder, x, count, logits);
  else
    nsvcd__decoder_by_floats(decoder, x, count, logits);
#endif
}
#endif  // NSVCD_NO_NETWORK

// =============================================================== query: a question, and its answer

// -------------------------------------------------------------------------------------- query/task
// In: two bodies and a motion. Out: an answer, by proof (proof/proof) or by the network
// (NeuralSVCD, algorithm 1). nsvcd_sweep stands at the end. A question goes through these phases:
//
//   check       is it in order, which method can answer it, and is the workspace large enough?
//   lay out     what it needs, and where in the workspace that is
//   who moves   of its two bodies; all is reckoned in the other's frame and units
//   answer      by proof, or by the network
//   write       what was found about moving and fixed, as facts about a and b
//
// A batch checks all of its questions before it answers the first one.

#ifndef NSVCD_NO_NETWORK
#ifndef NSVCD_NO_BASE
#define NSVCD__LARGEST_MODEL NSVCD_MODEL_BASE
#elif !defined(NSVCD_NO_SMALL)
#define NSVCD__LARGEST_MODEL NSVCD_MODEL_SMALL
#else
#define NSVCD__LARGEST_MODEL NSVCD_MODEL_TINY
#endif

// ---- the network's schedule
//
// The search finds pairs of patches whose balls meet. The deepest of them make the shortlist. The
// ranker, which is the tiny decoder, scores these while the search goes on, and the chosen decoder
// judges the K most suspicious. K is network.pairs, NSVCD_DEFAULT_PAIRS where nothing is said. That
// a motion is cut into 16 to 64 segments stands in *broad phase*, what goes through the decoder at
// once (NSVCD__BATCH, NSVCD__ROWS) in *decoder*, and what a proof may take in *proof*.

// pairs on the shortlist, times K; of the tiny decoder, which needs none, K: nsvcd__settings_of,
// nsvcd__needs_of
#define NSVCD__SHORTLIST 4
// new pairs that are worth the first look by the ranker, before the search is done. Later looks
// wait for NSVCD__BATCH: nsvcd__search_and_judge
#define NSVCD__FIRST_LOOK 8
// pairs that such looks may take, times the shortlist: nsvcd__search_and_judge
#define NSVCD__LOOKS 2
// pairs that the chosen decoder sees at once, until one is clear: nsvcd__judge; and pairs that are
// kept where the last of a batch collided: nsvcd__collides_again
#define NSVCD__PORTION 4
// a logit so far from 0 is clear. A clear collision needs no second pair (nsvcd__judge), and what
// is clear to the ranker no second decoder (nsvcd__is_clear): 35,000 answers on the validation
// sets, N = 128 to 512, are the same as with twice this, but for one, which is better
#define NSVCD__CLEAR_LOGIT 3.0f
// times that the place where the last of a batch collided may mislead before it is forgotten:
// nsvcd__answer_by_network
#define NSVCD__MISLEADS 2

// The network's options, with the defaults filled in.
typedef struct nsvcd__settings {
  size_t pairs;  // K
  // pairs that are kept
  size_t shortlist;
  const nsvcd__decoder *decoder, *ranker;
  int int8;
  // subtracted from the decoder's logit
  float threshold;
} nsvcd__settings;

// The candidate that an answer is about, and the decoder that gave its logit.
typedef struct nsvcd__decisive {
  nsvcd__candidate candidate;
  const nsvcd__decoder *decoder;
} nsvcd__decisive;
#endif  // NSVCD_NO_NETWORK

// ---- tasks, and their memory

// A question that has been checked.
typedef struct nsvcd__task {
  const nsvcd_body *moving, *fixed;
  nsvcd__motion motion;
  int swapped;  // the moving body is b, not a
  // extents of both bodies, in the fixed one's units
  float lengths;
  nsvcd_method method;  // PROOF or NETWORK
  // the caller's
  const nsvcd_question *question;
#ifndef NSVCD_NO_NETWORK
  // of the network
  nsvcd__settings settings;
  // written unless NULL
  nsvcd__decisive *decisive;
#endif
} nsvcd__task;

// What a workspace holds, at its beginning.
typedef struct nsvcd__query {
  nsvcd__search broad_phase;
  nsvcd__task task;
  // The memory of the network and that of the proof are in one place, for one follows the other.
#ifndef NSVCD_NO_NETWORK
  // (shortlist)
  nsvcd__candidate *kept;
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__proof *proof;
  nsvcd__span *spans;  // (S)
#endif
} nsvcd__query;

// What NSVCD_PROOF_WORKSPACE_BYTES and NSVCD_NETWORK_WORKSPACE_BYTES count on; where this does not
// compile they are wrong.
typedef char nsvcd__constants_hold
    [sizeof(nsvcd__query) + 3 * NSVCD_ALIGNMENT + NSVCD__PASSED_OVER <= 1024 &&
             sizeof(nsvcd__segments) <= 148 * 16 && sizeof(nsvcd__chords) <= 512 &&
             sizeof(nsvcd__cut) <= 16 * 512 && NSVCD__TILE_SLOTS == 32 &&
             NSVCD_ALIGNMENT == sizeof(uint64_t)
         ? 1
         : -1];
#ifndef NSVCD_NO_PROOF
typedef char nsvcd__proof_constants_hold
    [sizeof(nsvcd__proof) <= 24576 && sizeof(nsvcd__span) <= 168 ? 1 : -1];
#endif
#ifndef NSVCD_NO_NETWORK
typedef char nsvcd__network_constants_hold
    [NSVCD__SHORTLIST * sizeof(nsvcd__candidate) <= 96 && NSVCD__LATENT == 40 ? 1 : -1];
#endif

// Lays a query out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes that it takes.
static size_t nsvcd__query_layout(const nsvcd__needs *needs, char *base) {
  nsvcd__query counted;
  uint64_t used = 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd__query));
  nsvcd__query *query = at ? (nsvcd__query *)at : &counted;
  nsvcd__search_layout(needs, base, &used, &query->broad_phase);
  uint64_t end = used;
#ifndef NSVCD_NO_NETWORK
  uint64_t network = used;
  void *kept = nsvcd__take(base, &network, needs->candidates, sizeof(nsvcd__candidate));
  query->kept = (nsvcd__candidate *)kept;
  end = network;
#endif
#ifndef NSVCD_NO_PROOF
  uint64_t proof = used;
  const size_t spans = needs->proof ? needs->segments : 0;
  query->proof =
      (nsvcd__proof *)nsvcd__take(base, &proof, needs->proof != 0, sizeof(nsvcd__proof));
  query->spans = (nsvcd__span *)nsvcd__take(base, &proof, spans, sizeof(nsvcd__span));
  end = proof > end ? proof : end;
#endif
  return (size_t)end;
}

// What is said where no more than a verdict is known: they may go to where they are in the end if
// they are free all the way, else nowhere.
static void nsvcd__answer_begin(const nsvcd__task *task, nsvcd_verdict verdict,
                                nsvcd_answer *answer) {
  const nsvcd__track *moving = &task->motion.moving;
  const nsvcd__track *fixed = &task->motion.fixed;
  const int is_free = verdict == NSVCD_FREE;
  memset(answer, 0, sizeof *answer);
  answer->verdict = verdict;
  answer->time.low = answer->safe.time = is_free ? 1.0f : 0.0f;
  answer->time.high = is_free ? 1 : HUGE_VALF;
  answer->distance.high = HUGE_VALF;
  answer->depth = is_free ? 0 : HUGE_VALF;
  answer->safe.a = moving->poses[is_free ? moving->count - 1 : 0];
  answer->safe.b = fixed->poses[is_free ? fixed->count - 1 : 0];
  answer->nearest.gap = HUGE_VALF;
  answer->nearest.triangle_a = NSVCD_NO_TRIANGLE;
  answer->nearest.triangle_b = NSVCD_NO_TRIANGLE;
}

// Where the last of a batch collided by the network: the next is asked there first. Forgotten when
// it has misled MISLEADS times, or the bodies change.
typedef struct nsvcd__hint {
  int known;
  int misled;
  // patches
  uint32_t moving, fixed;
} nsvcd__hint;

// -------------------------------------------------------------------------------- query/by_network
// In: a task. Out: its answer, by the network: candidates, ranked, and a logit for the best of
// them.

#ifndef NSVCD_NO_NETWORK
// The settings for two bodies of so many patches. An error where the options ask for what is not
// there; *settings is then not whole. The threshold: weights.h has one per decoder, recall and N =
// 32, 64, ..., 512; between those, and for two bodies that differ, it is interpolated at the mean
// of log2 N.
static nsvcd_result nsvcd__settings_of(const nsvcd_network_options *o, size_t points1,
                                       size_t points2, nsvcd__settings *settings) {
  if (o->pairs > NSVCD_MAX_PAIRS || (unsigned)o->model > (unsigned)NSVCD_MODEL_BASE)
    return NSVCD_ERROR_ARGUMENT;
  if (o->precision != NSVCD_PRECISION_FLOAT && o->precision != NSVCD_PRECISION_INT8)
    return NSVCD_ERROR_ARGUMENT;
  const nsvcd_model model = o->model ? o->model : NSVCD__LARGEST_MODEL;
  const size_t decoder = (size_t)model - (size_t)NSVCD_MODEL_TINY;
  // compiled out
  if (!nsvcd_w_decoders[decoder].layers) return NSVCD_ERROR_ARGUMENT;
  settings->pairs = o->pairs ? o->pairs : NSVCD_DEFAULT_PAIRS;
  settings->shortlist = decoder == 0 ? settings->pairs : NSVCD__SHORTLIST * settings->pairs;
  settings->decoder = &nsvcd_w_decoders[decoder];
  settings->ranker = &nsvcd_w_decoders[0];
#ifdef NSVCD_NO_FLOAT
  settings->int8 = 1;
#else
  settings->int8 = o->precision == NSVCD_PRECISION_INT8;
#endif
#ifdef NSVCD_NO_INT8
  if (settings->int8) return NSVCD_ERROR_ARGUMENT;
#endif
  for (size_t k = 0; k < NSVCD_W_RECALLS && nsvcd__is_finite(o->recall); k++) {
    if (o->recall < nsvcd_w_recall[k] || o->recall > nsvcd_w_recall[k]) continue;
    const float last = NSVCD_W_SIZES - 1;
    const float size = 0.5f * (log2f((float)points1) + log2f((float)points2)) - 5;
    const float at = size < 0 ? 0 : size > last ? last : size;
    const size_t row = at < last ? (size_t)at : NSVCD_W_SIZES - 2;
    const float low = nsvcd_w_threshold[decoder][row][k];
    const float high = nsvcd_w_threshold[decoder][row + 1][k];
    settings->threshold = low + (at - (float)row) * (high - low);
    return NSVCD_OK;
  }
  return NSVCD_ERROR_ARGUMENT;
}

// Scores `count` candidates, 1 to 16, by a decoder.
static void nsvcd__decode(const nsvcd__task *task, nsvcd__candidate *const *candidates,
                          size_t count, const nsvcd__decoder *decoder) {
  for (size_t first = 0; first < count; first += NSVCD__ROWS) {
    const size_t left = count - first;
    const size_t rows = left < NSVCD__ROWS ? left : NSVCD__ROWS;
    // The layers take some rows at a time.
    const size_t unused = nsvcd__round_up(rows, NSVCD__ROW_STEP) - rows;
    float x[NSVCD__ROWS * NSVCD__DECODER_IN];
    float logits[NSVCD__ROWS];
    for (size_t l = 0; l < rows; l += NSVCD__SLICE) {
      const size_t size = rows - l < NSVCD__SLICE ? rows - l : NSVCD__SLICE;
      nsvcd__pairs pairs;
      nsvcd__pairs_of(task->moving, task->fixed, &task->motion, candidates + first + l, size,
                      &pairs);
      nsvcd__invariants(&pairs, size, x + NSVCD__DECODER_IN * l);
    }
    memset(x + NSVCD__DECODER_IN * rows, 0, unused * NSVCD__DECODER_IN * sizeof *x);
    nsvcd__decoder_logits(decoder, x, rows, task->settings.int8, logits);
    for (size_t k = 0; k < rows; k++) candidates[first + k]->score = logits[k];
  }
}

// Scores candidates that have no score yet, `most` at most: the deeper ones, roughly, because a
// heap ends with them. Returns 0, and does nothing, if there are fewer than `least`.
static int nsvcd__score(const nsvcd__task *task, nsvcd__candidates *kept, size_t least,
                        size_t most) {
  nsvcd__candidate *batch[NSVCD__BATCH];
  size_t count = 0;
  size_t left = 0;
  for (size_t k = 0; k < kept->count; k++) left += kept->items[k].score <= NSVCD__NO_SCORE;
  if (left < least || left == 0) return 0;
  left = left < most ? left : most;
  for (size_t k = kept->count; left > 0; k--) {
    nsvcd__candidate *candidate = &kept->items[k - 1];
    if (candidate->score > NSVCD__NO_SCORE) continue;
    batch[count++] = candidate;
    if (count < NSVCD__BATCH && count < left) continue;
    NSVCD__TALLY(ranked, count);
    nsvcd__decode(task, batch, count, task->settings.ranker);
    left -= count;
    count = 0;
  }
  return 1;
}

// Answers with a candidate, of which a decoder has given the score.
static void nsvcd__answer_with(const nsvcd__task *task, const nsvcd__candidate *candidate,
                               const nsvcd__decoder *decoder, nsvcd_opinion *out) {
  out->logit = candidate->score - task->settings.threshold;
  out->time = candidate->t_least;
  out->patch_a = candidate->moving;
  out->patch_b = candidate->fixed;
  if (task->decisive) {
    task->decisive->candidate = *candidate;
    task->decisive->decoder = decoder;
  }
}

// Does the tiny decoder see no collision there, clearly?
static int nsvcd__is_harmless(const nsvcd__candidate *candidate, float threshold) {
  return candidate->score < (threshold < 0 ? threshold : 0) - NSVCD__CLEAR_LOGIT;
}

// Is the most suspicious of the candidates scored so far clearly a collision, or, where they are
// all, clearly none? Then that is the answer, and no other decoder needs to look.
static int nsvcd__is_clear(const nsvcd__task *task, const nsvcd__candidates *kept, int all,
                           nsvcd_opinion *out) {
  const float threshold = task->settings.threshold;
  const nsvcd__candidate *most = &kept->items[0];
  for (size_t k = 1; k < kept->count; k++)
    most = kept->items[k].score > most->score ? &kept->items[k] : most;
  const int yes = most->score > NSVCD__CLEAR_LOGIT + (threshold > 0 ? threshold : 0);
  const int no = all && nsvcd__is_harmless(most, threshold);
  if (yes || no) nsvcd__answer_with(task, most, task->settings.ranker, out);
  return yes || no;
}

// The verdict on the K most suspicious of the scored candidates, but for the harmless ones, a
// portion at a time, until one is clearly positive.
static void nsvcd__judge(const nsvcd__task *task, nsvcd__candidates *kept,
                         nsvcd_opinion *out) {
  const nsvcd__settings *settings = &task->settings;
  nsvcd__candidate *items = kept->items;
  size_t count = kept->count < settings->pairs ? kept->count : settings->pairs;
  // those of the highest scores come first, in falling order
  for (size_t k = 0; k < count; k++) {
    size_t best = k;
    for (size_t i = k + 1; i < kept->count; i++) {
      const float d = items[i].score - items[best].score;
      if (d > 0 || (d >= 0 && nsvcd__is_shallower(&items[best], &items[i]))) best = i;
    }
    const nsvcd__candidate first = items[best];
    items[best] = items[k];
    items[k] = first;
  }
  while (count > 1 && nsvcd__is_harmless(&items[count - 1], settings->threshold)) count--;
  for (size_t first = 0; first < count; first += NSVCD__PORTION) {
    if (!(out->logit < NSVCD__CLEAR_LOGIT)) break;
    nsvcd__candidate *portion[NSVCD__PORTION] = {NULL};
    const size_t left = count - first;
    const size_t size = left < NSVCD__PORTION ? left : NSVCD__PORTION;
    for (size_t k = 0; k < size; k++) portion[k] = &items[first + k];
    if (settings->decoder != settings->ranker) {
      NSVCD__TALLY(judged, size);
      nsvcd__decode(task, portion, size, settings->decoder);
    }
    for (size_t k = 0; k < size; k++) {
      const int is_first = first + k == 0;
      if (is_first || portion[k]->score - settings->threshold > out->logit)
        nsvcd__answer_with(task, portion[k], settings->decoder, out);
    }
  }
}

// Does this motion, cut already, clearly collide where the hint says?
static NSVCD__APART int nsvcd__collides_again(nsvcd__query *query, const nsvcd__hint *hint,
                                              nsvcd_opinion *out) {
  const nsvcd__task *task = &query->task;
  const nsvcd__settings *settings = &task->settings;
  nsvcd__candidates kept;
  nsvcd__candidates_start(&kept, query->kept, NSVCD__PORTION);
  nsvcd__search_patch(&query->broad_phase, task->moving, hint->moving / NSVCD__GROUP,
                      task->fixed, hint->fixed, &kept);
  if (!nsvcd__score(task, &kept, 1, kept.count)) return 0;
  out->candidates = kept.total;
  out->limited = kept.total > settings->pairs;
  if (nsvcd__is_clear(task, &kept, 0, out)) return 1;
  if (settings->decoder == settings->ranker) return 0;
  nsvcd__judge(task, &kept, out);
  return out->logit >= NSVCD__CLEAR_LOGIT;
}

// Searches a motion that has been cut, looking at pairs as they are found, until one is clear or
// all are known.
static NSVCD__APART void nsvcd__search_and_judge(nsvcd__query *query, nsvcd_opinion *out) {
  const nsvcd__task *task = &query->task;
  const size_t shortlist = task->settings.shortlist;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__candidates kept;
  size_t worth = shortlist < NSVCD__FIRST_LOOK ? shortlist : NSVCD__FIRST_LOOK;
  size_t left = NSVCD__LOOKS * shortlist;
  int clear = 0;
  int more = nsvcd__search_begin(task->moving, task->fixed, ~(uint64_t)0, search);
  nsvcd__candidates_start(&kept, query->kept, shortlist);
  while (more && !clear) {
    more = nsvcd__search_step(search, &kept);
    // A deep collision shows early. What is scored now need not be scored later, so that looking
    // costs little.
    if (!more || left < worth || !nsvcd__score(task, &kept, worth, worth)) continue;
    left -= worth;
    clear = nsvcd__is_clear(task, &kept, 0, out);
    if (worth == NSVCD__FIRST_LOOK) worth = NSVCD__BATCH;
  }

  out->candidates = kept.total;
  out->limited = kept.total > task->settings.pairs;
  if (clear || kept.count == 0) return;
  nsvcd__score(task, &kept, 1, kept.count);
  if (!nsvcd__is_clear(task, &kept, 1, out)) nsvcd__judge(task, &kept, out);
}

// Is a part of one body inside of the other at the start?
static NSVCD__APART int nsvcd__starts_inside(const nsvcd__task *task) {
  const nsvcd__transform pose = nsvcd__motion_pose(&task->motion, 0);
  return nsvcd__is_contained(task->moving, task->fixed, task->motion.scale, &pose);
}

// What is thought where no decoder is needed.
static nsvcd_opinion nsvcd__certain_opinion(float logit) {
  nsvcd_opinion out;
  memset(&out, 0, sizeof out);
  out.asked = 1;
  out.logit = logit;
  return out;
}

// Asks the network about a motion that has been prepared. hint: NULL, or that of a batch. Returns
// whether one body seems to be inside the other at the start.
static int nsvcd__ask_network(nsvcd__query *query, nsvcd__hint *hint, nsvcd_opinion *out) {
  nsvcd__task *task = &query->task;
  const int hinted = hint && hint->known;
  // checked before
  (void)nsvcd__settings_of(&task->question->network, task->moving->patches,
                           task->fixed->patches, &task->settings);
  *out = nsvcd__certain_opinion(-NSVCD_LOGIT_CERTAIN);
  if (nsvcd__motion_gap(&task->motion) > task->lengths) return 0;
  nsvcd__cut_motion(&task->motion, task->lengths, &query->broad_phase);
  if (!hinted || !nsvcd__collides_again(query, hint, out)) {
    *out = nsvcd__certain_opinion(-NSVCD_LOGIT_CERTAIN);
    if (hinted) hint->known = ++hint->misled < NSVCD__MISLEADS;
    nsvcd__search_and_judge(query, out);
  }
  if (hint && out->logit >= NSVCD__CLEAR_LOGIT) {
    const nsvcd__hint here = {1, 0, out->patch_a, out->patch_b};
    *hint = here;
  }

  // a body inside another need not touch anything
  if (!nsvcd__starts_inside(task)) return 0;
  const size_t candidates = out->candidates;
  *out = nsvcd__certain_opinion(NSVCD_LOGIT_CERTAIN);
  out->candidates = candidates;
  return 1;
}

// The network's answer.
static void nsvcd__answer_by_network(nsvcd__query *query, nsvcd__hint *hint,
                                     nsvcd_answer *answer) {
  nsvcd_opinion opinion;
  const int inside = nsvcd__ask_network(query, hint, &opinion);
  nsvcd__answer_begin(&query->task, opinion.logit > 0 ? NSVCD_HIT : NSVCD_FREE, answer);
  answer->inside = inside;
  answer->opinion = opinion;
  if (opinion.candidates > 0 || inside) answer->by = NSVCD_BY_NETWORK;
  if (opinion.logit > 0) answer->time.high = opinion.time;
}
#endif  // NSVCD_NO_NETWORK

// ---------------------------------------------------------------------------------- query/by_proof
// In: a task. Out: its answer, by proof, with the contact as places in the world.

#ifndef NSVCD_NO_PROOF
// Where a body is at time t in [0,1], in the world.
static nsvcd__dquat nsvcd__turn_at(const nsvcd__motion *motion, const nsvcd__track *track,
                                   double t, nsvcd__d3 *position) {
  nsvcd__leg leg;
  nsvcd__d3 ends[2];
  double u;
  const uint32_t first = nsvcd__arc_of(motion, t * (double)motion->ticks, &u);
  nsvcd__leg_init(track, first, nsvcd__next_knot(motion, first) - first, &leg, ends);
  *position = nsvcd__d3_mix(ends[0], ends[1], u);
  return nsvcd__leg_at(&leg, u);
}

// From the fixed body's frame and units to the world, at time t.
typedef struct nsvcd__to_world {
  nsvcd__dmat3 rotation;
  nsvcd__d3 position;
  double unit;
} nsvcd__to_world;

static nsvcd__to_world nsvcd__to_world_at(const nsvcd__motion *motion, double t) {
  nsvcd__to_world out;
  const nsvcd__dquat turn = nsvcd__turn_at(motion, &motion->fixed, t, &out.position);
  out.rotation = nsvcd__dmat3_of(turn);
  out.unit = (double)motion->unit;
  return out;
}

// To how many of the fixed body's units an answer is asked for, or is by default.
static double nsvcd__to_of(const nsvcd__task *task) {
  const nsvcd_question *q = task->question;
  const float moving = task->motion.scale * nsvcd__whole_radius(task->moving);
  const float fixed = nsvcd__whole_radius(task->fixed);
  const float usual = NSVCD_DEFAULT_TO * (moving < fixed ? moving : fixed);
  return (double)(q->to > 0 ? q->to / task->motion.unit : usual);
}

// How far points of the moving body go in an arc, at most.
static double nsvcd__way_in(const nsvcd__proof *p, const nsvcd__arc *arc) {
  return arc->speed + arc->turn * arc->scale * (double)p->moving.body->extent;
}

// The share of the motion in which no point of the moving body goes farther than `to`, if that is
// asked for, nor longer than `share`, if that is. Of a short motion a quarter of its way, so that
// not all of it is lost to a contact, if that is more than the hairs that a safe place is before.
static double nsvcd__share_of(nsvcd__proof *p, double to, double share) {
  const nsvcd__motion *motion = p->ask.motion;
  const double most = share > 0 ? share : 1;
  double fastest = 0;  // per tick
  // that of the question before
  p->arc.ticks = 0;
  for (uint32_t first = 0; to > 0 && first < motion->ticks;) {
    const nsvcd__arc *arc = nsvcd__arc_at(p, first);
    fastest = fmax(fastest, nsvcd__way_in(p, arc) / (double)arc->ticks);
    first += arc->ticks;
  }
  const double whole = fastest * (double)motion->ticks;
  const double least = fmin(to, fmax(0.25 * whole, NSVCD__HAIRS * nsvcd__hair(p)));
  return least < most * whole ? least / whole : most;
}

// Makes the proof ready for a question whose motion has been prepared.
static void nsvcd__proof_begin(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd_question *q = task->question;
  const float unit = task->motion.unit;
  nsvcd__proof *p = query->proof;
  p->spans = query->spans;
  p->ask.motion = &query->task.motion;
  p->moving = nsvcd__facets_of(nsvcd__triangles_of(task->moving));
  p->fixed = nsvcd__facets_of(nsvcd__triangles_of(task->fixed));
  p->given.lengths = task->motion.scale * p->moving.body->extent + p->fixed.body->extent;
  p->given.tolerance = (double)(q->tolerance / unit);
  const double moving_round = (double)p->moving.round * (double)task->motion.scale;
  p->given.round = moving_round + (double)p->fixed.round;
  p->given.clearance = (double)(q->clearance / unit) + p->given.round;
  p->ask.clearance = p->given.clearance;
  p->given.skin = (double)(q->skin / unit);
  p->given.work = p->ask.limit = q->work ? q->work : NSVCD_DEFAULT_WORK;
  p->given.tells = q->ask != NSVCD_ASK_HIT || q->skin / unit > 0;
  p->ask.measure = p->ask.first = p->ask.share = p->low = p->given.share = p->given.width = 0;
  p->normal_count = 0;
  p->high = HUGE_VAL;
  p->work = 0;
  p->ask.gathers = NSVCD__CONTACTS;
  p->ask.is_brief = p->ask.by_time = p->within = p->unclear = p->wide = p->starts_free = 0;
  const double to = nsvcd__to_of(task);
  p->given.to = q->to > 0 && q->ask == NSVCD_ASK_FIRST ? to : 0;
  const int by_time = q->to_time > 0 && !(q->to > 0);
  if (q->ask == NSVCD_ASK_DISTANCE) p->given.width = to;
  if (q->ask == NSVCD_ASK_FIRST)
    p->given.share = nsvcd__share_of(p, by_time ? 0 : to, (double)q->to_time);
  p->ask.share = p->given.share;
  nsvcd__proof_restart(p);
}

// The contact that a proof has found: when, where, and of what. Where the two were swapped it is
// the fixed body that counts as lifted, the other way.
static NSVCD__APART void nsvcd__tell_contact(const nsvcd__query *query,
                                             const nsvcd__contact *found, nsvcd_contact *out) {
  const nsvcd__proof *p = query->proof;
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *motion = &task->motion;
  const int rests = motion->moving.count == 1 && !motion->fixed_moves;
  const double time = rests ? 0 : found->tick / (double)motion->ticks;
  const nsvcd__to_world world = nsvcd__to_world_at(motion, time);
  const nsvcd__d3 lift = nsvcd__d3_scale(nsvcd__d3_widen(motion->lift), task->swapped);
  const double beyond = fmin((double)p->fixed.round, found->distance);
  const nsvcd__d3 on = nsvcd__d3_fma(beyond, found->normal, found->point);
  const nsvcd__d3 seen = nsvcd__d3_scale(nsvcd__d3_sub(on, lift), world.unit);
  const nsvcd__d3 point =
      nsvcd__d3_add(nsvcd__dmat3_apply(&world.rotation, seen), world.position);
  const nsvcd__d3 normal = nsvcd__dmat3_apply(&world.rotation, found->normal);
  nsvcd__f3_store(nsvcd__f3_round(point), out->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), out->normal);
  out->gap = (float)(fmax(found->distance - p->given.round, 0) * world.unit);
  out->time = (float)time;
  out->triangle_a = found->moving_triangle;
  out->triangle_b = found->fixed_triangle;
  out->patch_a = found->moving_patch;
  out->patch_b = found->fixed_patch;
}

static nsvcd_pose nsvcd__pose_of(nsvcd__dquat turn, nsvcd__d3 place) {
  nsvcd_pose out;
  float *q = out.rotation;
  q[0] = (float)turn.x;
  q[1] = (float)turn.y;
  q[2] = (float)turn.z;
  q[3] = (float)turn.w;
  nsvcd__f3_store(nsvcd__f3_round(place), out.position);
  return out;
}

// Where both bodies are at time t, the one that takes the lift displaced by so much, in the fixed
// one's frame and units. The one that moves takes it; if both do, a.
static int nsvcd__takes_lift(const nsvcd__task *task) {
  return !task->swapped || !(task->motion.fixed_moves || task->motion.moving.count == 1);
}
static NSVCD__APART void nsvcd__poses_at(const nsvcd__task *task, double t, nsvcd__d3 lift,
                                         nsvcd_pose *moving, nsvcd_pose *fixed) {
  const nsvcd__motion *motion = &task->motion;
  const int moving_takes_it = nsvcd__takes_lift(task);
  const nsvcd__to_world world = nsvcd__to_world_at(motion, t);
  const nsvcd__d3 seen = nsvcd__dmat3_apply(&world.rotation, lift);
  for (int n = 0; n < 2; n++) {
    const double by = n == moving_takes_it ? 0 : n ? -world.unit : world.unit;
    nsvcd__d3 place;
    const nsvcd__dquat turn =
        nsvcd__turn_at(motion, n ? &motion->fixed : &motion->moving, t, &place);
    place = nsvcd__d3_add(place, nsvcd__d3_scale(seen, by));
    *(n ? fixed : moving) = nsvcd__pose_of(turn, place);
  }
}

// Sets the bodies down at time t, where they are free of each other when lifted as the motion is:
// to a little more than what they are pressed in by at the start, or to a little before they are in
// contact. Returns how far they are lifted then, which is proven to be free, and all the way down
// to it. All else that was known of the question is lost.
static NSVCD__APART nsvcd__d3 nsvcd__set_down(nsvcd__query *query, double t) {
  nsvcd__proof *p = query->proof;
  const nsvcd__task *task = &query->task;
  nsvcd__motion *whole = p->ask.motion;
  nsvcd__motion down = *whole;
  nsvcd_pose moving[2], fixed[2];
  const int takes_it = nsvcd__takes_lift(task);
  const nsvcd__track moves = {moving, NULL, takes_it ? 2u : 1u, 0, 0};
  const nsvcd__track rests = {fixed, NULL, takes_it ? 1u : 2u, 0, 0};
  const nsvcd__d3 lift = nsvcd__d3_widen(whole->lift);
  // nearer to each other than stored triangles are known, nothing would be parted
  const double kept = fmax(NSVCD__SET_DOWN * p->ask.skin, 4 * nsvcd__hair(p));
  const nsvcd__d3 least = nsvcd__lift_off(p, kept, 1);
  const nsvcd__d3 by = nsvcd__d3_sub(lift, least);
  const double way = nsvcd__d3_length(by);
  if (!(nsvcd__d3_dot(by, lift) > 0) || !(way > kept)) return lift;
  nsvcd__poses_at(task, t, lift, &moving[0], &fixed[0]);
  nsvcd__poses_at(task, t, least, &moving[1], &fixed[1]);
  nsvcd__motion_set_tracks(&down, moves, rests);
  down.lift = nsvcd__f3_of(0, 0, 0);
  p->ask.motion = &down;
  p->ask.share = kept / way;
  p->ask.measure = 0;
  p->ask.clearance = p->given.clearance;
  p->ask.limit = p->work + p->given.work / NSVCD__IN_DOUBT;
  (void)nsvcd__prove_anew(p, &query->broad_phase);
  p->ask.motion = whole;
  const double until = nsvcd__clear_until(p) / (double)down.ticks;
  // up to a doubt it is proven, but not so that it is proven anew from there
  const double clear = p->known.unsure < p->ask.end ? until - 0.5 * p->ask.share : until;
  return nsvcd__d3_sub(lift, nsvcd__d3_scale(by, fmin(fmax(clear, 0), 1)));
}

// The bodies as they are at time t, as a motion of its own, with the fixed one's origin in the
// world's: places in its frame are as exact as if it were there.
static nsvcd__motion nsvcd__rest_at(const nsvcd__task *task, double t, nsvcd_pose *poses) {
  nsvcd__motion still = task->motion;
  const nsvcd__track tracks[2] = {{&poses[0], NULL, 1, 0, 0}, {&poses[1], NULL, 1, 0, 0}};
  const nsvcd__d3 here = {0, 0, 0};
  nsvcd__d3 place, origin;
  const nsvcd__dquat turn = nsvcd__turn_at(&still, &still.moving, t, &place);
  const nsvcd__dquat fixed_turn = nsvcd__turn_at(&still, &still.fixed, t, &origin);
  const nsvcd__dmat3 rotation = nsvcd__dmat3_of(fixed_turn);
  const nsvcd__d3 lift = nsvcd__dmat3_apply(&rotation, nsvcd__d3_widen(still.lift));
  place = nsvcd__d3_sub(place, origin);
  place = nsvcd__d3_add(place, nsvcd__d3_scale(lift, (double)still.unit));
  poses[0] = nsvcd__pose_of(turn, place);
  poses[1] = nsvcd__pose_of(fixed_turn, here);
  nsvcd__motion_set_tracks(&still, tracks[0], tracks[1]);
  still.lift = nsvcd__f3_of(0, 0, 0);
  return still;
}

// Against the normal of a contact's moving triangle, as the bodies rest.
static nsvcd__d3 nsvcd__against(nsvcd__proof *p, const nsvcd__contact *found) {
  const size_t patch = found->moving_patch;
  const nsvcd__placement at = nsvcd__placement_at(nsvcd__arc_at(p, 0), 0);
  nsvcd__d3 corners[3], posed[3];
  size_t n = p->moving.first_triangle[patch];
  while (nsvcd__facet_number(&p->moving, patch, n) != found->moving_triangle) n++;
  nsvcd__facet_triangle(&p->moving, patch, n, corners);
  nsvcd__place_triangle(&at, corners, posed);
  return nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
}

// The manifold of the contact that was found. Where a body stands, that may be one of a side that
// rises from what it stands on: the normal of either triangle is tried, and what spans more counts.
// All else that was known of the question is lost.
static NSVCD__APART void nsvcd__tell_manifold(nsvcd__query *query, nsvcd_answer *answer) {
  nsvcd__proof *p = query->proof;
  const nsvcd__task *task = &query->task;
  const nsvcd__contact found = p->known.found;
  const nsvcd__asked asked = p->ask;
  const double hair = nsvcd__hair(p);
  const double same = hair + 1e-5 * (double)p->given.lengths;
  const float radius = task->motion.scale * task->moving->radius;
  const double extent = (double)fminf(radius, task->fixed->radius);
  const nsvcd__manifold *m = &p->of.kept.manifold;
  double widest = -1;
  nsvcd_pose poses[2];
  nsvcd__motion still = nsvcd__rest_at(task, (double)answer->nearest.time, poses);
  p->ask.motion = &still;
  p->ask.gathers = NSVCD__SUPPORTING;
  p->ask.clearance = p->given.clearance + fmax(nsvcd__to_of(task), 4 * hair);
  p->ask.limit = p->work + p->given.work / NSVCD__IN_DOUBT;
  (void)nsvcd__prove_anew(p, &query->broad_phase);
  const nsvcd__d3 normals[2] = {found.normal, nsvcd__against(p, &found)};
  int tries = nsvcd__d3_dot(normals[0], normals[1]) > 0.9 ? 1 : 2;
  for (int k = 0; k < tries; k++) {
    int chosen[NSVCD_MAX_CONTACTS];
    double area;
    nsvcd__begin_places(p, normals[k], p->ask.clearance, same);
    nsvcd__seek_places(p, 0, NSVCD__AROUND);
    int count = nsvcd__choose_four(m, chosen, &area);
    if (nsvcd__look_across(&p->of.kept.manifold, area)) {
      nsvcd__seek_places(p, NSVCD__AROUND, NSVCD__SUPPORTS);
      count = nsvcd__choose_four(m, chosen, &area);
    }
    if (count == 0 || !(area > 1.001 * widest)) continue;
    widest = area;
    if (count > 2 && area > 0.1 * extent * extent) tries = 1;
    answer->contact_count = (size_t)count;
    for (int n = 0; n < count; n++) {
      nsvcd__contact support = m->supports[chosen[n]];
      support.tick = found.tick;
      nsvcd__tell_contact(query, &support, &answer->contacts[n]);
      // which body a corner is of
      answer->contacts[n].id = m->numbers[chosen[n]] ^ (uint32_t)task->swapped;
    }
  }
  p->ask = asked;
}

// Where the bodies may go, which are proven free until answer->time.low; and how deep they are in
// contact at the start.
static NSVCD__APART void nsvcd__tell_safe_place(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const nsvcd__proof *p = query->proof;
  const double t = (double)answer->safe.time;
  nsvcd__d3 lift = nsvcd__d3_widen(task->motion.lift);
  const int is_lifted = nsvcd__d3_dot(lift, lift) > 0;
  if (is_lifted) {
    const double depth = nsvcd__d3_length(nsvcd__lift_off(p, 0, 1));
    answer->depth = (float)(depth * (double)task->motion.unit);
    if (!p->unclear) lift = nsvcd__set_down(query, t);
  } else if (answer->time.low > 0 || p->starts_free) {
    answer->depth = 0;
  }
  // at the ends they are as the caller has them: nsvcd__answer_begin
  if (is_lifted || (t > 0 && t < 1))
    nsvcd__poses_at(task, t, lift, &answer->safe.a, &answer->safe.b);
}

// Proves a question whose motion has been prepared, if it can.
static void nsvcd__answer_by_proof(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const nsvcd_question *q = task->question;
  const double unit = (double)task->motion.unit;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__proof *p = query->proof;
  nsvcd__proof_begin(query);
  if (p->given.skin > 0) nsvcd__lift_motion(p, search);
  nsvcd__verdict verdict = nsvcd__prove(p, search);
  if (p->given.width > 0 && verdict != NSVCD__WITHIN) {
    nsvcd__measure(p, search, verdict, p->given.width);
    // A distance decides what was left undecided, but tells nothing of what is inside of what.
    const int meets = p->known.has_contact && p->known.found.distance <= p->given.clearance;
    const int is_clear =
        p->low > 0 && p->low >= p->given.clearance && !p->unclear && !p->within;
    if (verdict == NSVCD__UNDECIDED && (meets || is_clear))
      verdict = meets ? NSVCD__MEETS : NSVCD__FREE;
  }

  // The triangles that the answer names are those of a contact, or else of a doubt.
  const int has_doubt = p->known.unsure < NSVCD__NEVER;
  const int names = p->known.has_contact || (verdict == NSVCD__UNDECIDED && has_doubt);
  const int is_within = verdict == NSVCD__WITHIN;
  const int is_free = verdict == NSVCD__FREE;
  const int is_hit = is_within || verdict == NSVCD__MEETS;
  nsvcd__answer_begin(task,
                      is_free  ? NSVCD_FREE
                      : is_hit ? NSVCD_HIT
                               : NSVCD_UNDECIDED,
                      answer);
  answer->inside = is_within;
  if (names || is_within) nsvcd__tell_contact(query, &p->known.found, &answer->nearest);
  if (is_within) answer->nearest.gap = HUGE_VALF;
  if (is_hit) answer->time.high = answer->nearest.time;
  if (verdict == NSVCD__MEETS) answer->contacts[answer->contact_count++] = answer->nearest;

  // What is proven of times and distances.
  if (p->given.share > 0 && !is_free && !is_within) {
    const nsvcd__motion *motion = p->ask.motion;
    const double ticks = (double)motion->ticks;
    const double until = fmin(fmax(nsvcd__clear_until(p) / ticks, 0), 1);
    const double late = (double)answer->time.high - until;
    answer->time.low = (float)(until * (1 - 1e-7));
    if (late > p->given.share * 1.0001 + 1e-6) answer->why = NSVCD_WHY_WORK;
    // nearer than this it is proven on the way, but who asks again from there would not be told so
    double u;
    const nsvcd__arc *arc = nsvcd__arc_at(p, nsvcd__arc_of(motion, until * ticks, &u));
    const double way = nsvcd__way_in(p, arc) * ticks / (double)arc->ticks;
    const double hairs = NSVCD__HAIRS * nsvcd__hair(p);
    const double back = way > hairs ? hairs / way : p->given.share;
    answer->safe.time = (float)fmax(0, until - back);
  }
  double low = is_free ? fmax(p->given.clearance, p->low) : p->low;
  double high = p->high;
  if (names) {
    const nsvcd__contact *found = &p->known.found;
    const float quanta = nsvcd__quanta_of(p, found->moving_patch, found->fixed_patch);
    high = fmax(found->distance, p->given.round) + (double)quanta;
  }
  low = fmax(low - p->given.round, 0);
  high -= p->given.round;
  answer->distance.low = (float)(low * unit * (1 - 1e-6));
  answer->distance.high = is_within ? 0 : (float)(high * unit * (1 + 1e-6));
  if (p->wide || answer->verdict == NSVCD_UNDECIDED) answer->why = NSVCD_WHY_WORK;
  if (answer->why && !p->wide && (has_doubt || p->unclear)) answer->why = NSVCD_WHY_TOO_NEAR;

  // By what the moving body was lifted, in the world at the start.
  const nsvcd__d3 lift = nsvcd__d3_widen(task->motion.lift);
  if (nsvcd__d3_dot(lift, lift) > 0) {
    const nsvcd__to_world start = nsvcd__to_world_at(&task->motion, 0);
    const nsvcd__d3 turned = nsvcd__dmat3_apply(&start.rotation, lift);
    nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(turned, start.unit)), answer->lift);
  }
  if (q->manifold && verdict == NSVCD__MEETS) nsvcd__tell_manifold(query, answer);
  nsvcd__tell_safe_place(query, answer);
  answer->work = p->work;
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------------- query/question
// In: questions and a workspace. Out: answers, or why not.

// The method that answers, or DEFAULT where there is none.
static nsvcd_method nsvcd__method_of(const nsvcd_body *moving, const nsvcd_body *fixed,
                                     nsvcd_method wanted) {
  int can_prove = 0;
  int can_ask = 0;
#ifndef NSVCD_NO_PROOF
  can_prove = moving->triangles && fixed->triangles;
#endif
#ifndef NSVCD_NO_NETWORK
  can_ask = moving->weights_id && fixed->weights_id;
#endif
  if (can_prove && wanted != NSVCD_METHOD_NETWORK) return NSVCD_METHOD_PROOF;
  if (can_ask && wanted != NSVCD_METHOD_PROOF) return NSVCD_METHOD_NETWORK;
  (void)moving;
  (void)fixed;
  return NSVCD_METHOD_DEFAULT;
}

// Is a question in order?
static nsvcd_result nsvcd__question_check(const nsvcd_question *question) {
  const nsvcd_mover *a = &question->a;
  const nsvcd_mover *b = &question->b;
  nsvcd_result result = nsvcd__mover_check(a);
  if (!result) result = nsvcd__mover_check(b);
  if (result) return result;
  // One and the same body in the same motion: something was passed twice.
  const float scale_a = nsvcd__scale_of(a);
  const float scale_b = nsvcd__scale_of(b);
  const int same_size = !(scale_a < scale_b) && !(scale_b < scale_a);
  const int same_motion = a->poses == b->poses && a->times == b->times && a->count == b->count;
  if (a->body == b->body && same_motion && same_size) return NSVCD_ERROR_SAME;

  // Are the options' numbers in their ranges, and do they go together?
  const nsvcd_question *q = question;
  const float lengths[5] = {q->tolerance, q->clearance, q->to, q->skin, q->to_time};
  if ((unsigned)q->method > (unsigned)NSVCD_METHOD_NETWORK) return NSVCD_ERROR_ARGUMENT;
  if ((unsigned)q->ask > (unsigned)NSVCD_ASK_DISTANCE) return NSVCD_ERROR_ARGUMENT;
  if (q->segments > NSVCD__MAX_SEGMENTS || q->segments % NSVCD__LANES)
    return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 5; k++) {
    const float most = k < 4 ? NSVCD_MAX_COORDINATE : 1;
    if (!nsvcd__is_finite(lengths[k])) return NSVCD_ERROR_TOLERANCE;
    if (lengths[k] < 0 || lengths[k] > most) return NSVCD_ERROR_TOLERANCE;
  }
  if (q->to > 0 && q->ask == NSVCD_ASK_HIT) return NSVCD_ERROR_ARGUMENT;
  if (q->to_time > 0 && q->ask != NSVCD_ASK_FIRST) return NSVCD_ERROR_ARGUMENT;
  if (q->manifold && q->ask != NSVCD_ASK_FIRST) return NSVCD_ERROR_ARGUMENT;
  // of these the network knows nothing
  const int needs_proof = q->ask != NSVCD_ASK_HIT || q->clearance > 0 || q->skin > 0;
  if (needs_proof && q->method == NSVCD_METHOD_NETWORK) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_method wanted = needs_proof ? NSVCD_METHOD_PROOF : q->method;
  if (nsvcd__method_of(a->body, b->body, wanted) == NSVCD_METHOD_DEFAULT)
    return NSVCD_ERROR_BODY;
#ifndef NSVCD_NO_NETWORK
  nsvcd__settings unused;
  return nsvcd__settings_of(&q->network, a->body->patches, b->body->patches, &unused);
#else
  return NSVCD_OK;
#endif
}

// ---- who moves

// Is b to be the one that moves, and a the one in whose frame that is seen? The one that rests is
// that, else the larger one; where they are equal, any rule that does not depend on which is a:
// then both ways of asking are answered alike.
static int nsvcd__is_swapped(const nsvcd_mover *a, const nsvcd_mover *b) {
  const size_t count_a = nsvcd__pose_count(a);
  const size_t count_b = nsvcd__pose_count(b);
  if ((count_a > 1) != (count_b > 1)) return count_b > 1;
  const float size_a = nsvcd__scale_of(a) * a->body->extent;
  const float size_b = nsvcd__scale_of(b) * b->body->extent;
  if (size_a < size_b || size_b < size_a) return size_b < size_a;
  if (a->body->checksum != b->body->checksum) return b->body->checksum < a->body->checksum;
  if (count_a != count_b) return count_b < count_a;
  const nsvcd_pose *poses_a = a->poses ? a->poses : &nsvcd__at_origin;
  const nsvcd_pose *poses_b = b->poses ? b->poses : &nsvcd__at_origin;
  const int order = memcmp(poses_b, poses_a, count_a * sizeof *poses_a);
  if (order || count_a == 1 || a->times == b->times) return order < 0;
  if (!a->times || !b->times) return !b->times;
  return memcmp(b->times, a->times, count_a * sizeof *a->times) < 0;
}

// ---- lay out

// What a question that is in order needs; NULL: what any may need. Which of its bodies is to be the
// moving one makes no difference to how much that is.
static nsvcd__needs nsvcd__needs_of(const nsvcd_question *question) {
  nsvcd__needs needs = {NSVCD__TILE_SLOTS, NSVCD__TILE_SLOTS, 1, NSVCD__MAX_SEGMENTS, 0, 1};
#ifndef NSVCD_NO_NETWORK
  needs.candidates = NSVCD__SHORTLIST * NSVCD_MAX_PAIRS;
#endif
  if (!question) return needs;
  const nsvcd_body *a = question->a.body;
  const nsvcd_body *b = question->b.body;
  const int swapped = nsvcd__is_swapped(&question->a, &question->b);
  const size_t moving_groups = nsvcd__body_groups(swapped ? b : a);
  const size_t fixed_groups = nsvcd__body_groups(swapped ? a : b);
  if (moving_groups < NSVCD__TILE_SLOTS) needs.moving_groups = moving_groups;
  if (fixed_groups < NSVCD__TILE_SLOTS) needs.fixed_groups = fixed_groups;
  needs.large = nsvcd__is_tiled(a, b);
  if (question->segments) needs.segments = nsvcd__round_up(question->segments, NSVCD__LANES);
  needs.proof = nsvcd__method_of(a, b, question->method) == NSVCD_METHOD_PROOF;
#ifndef NSVCD_NO_NETWORK
  const nsvcd_network_options *options = &question->network;
  const size_t pairs = options->pairs ? options->pairs : NSVCD_DEFAULT_PAIRS;
  const size_t most = options->model == NSVCD_MODEL_TINY ? pairs : NSVCD__SHORTLIST * pairs;
  needs.candidates = most > NSVCD__PORTION ? most : NSVCD__PORTION;
  if (!a->weights_id || !b->weights_id) needs.candidates = 0;
#endif
  return needs;
}

// As nsvcd_sweep_workspace_size.
static size_t nsvcd__sweep_size(const nsvcd_question *question) {
  if (question && nsvcd__question_check(question)) return 0;
  const nsvcd__needs needs = nsvcd__needs_of(question);
  return nsvcd__query_layout(&needs, NULL);
}

// Checks a question, and that the workspace is large enough for it.
static NSVCD__APART nsvcd_result nsvcd__check(const nsvcd_question *question,
                                              const void *workspace, size_t workspace_size) {
  const nsvcd_result result = nsvcd__question_check(question);
  if (result) return result;
  if (!workspace || !nsvcd__is_aligned(workspace)) return NSVCD_ERROR_WORKSPACE;
  const nsvcd__needs needs = nsvcd__needs_of(question);
  const size_t size = nsvcd__query_layout(&needs, NULL);
  return workspace_size >= size ? NSVCD_OK : NSVCD_ERROR_WORKSPACE;
}

// Lays a question that has been checked out in the workspace, and chooses who moves.
static NSVCD__APART nsvcd__query *nsvcd__query_open(const nsvcd_question *question,
                                                    void *workspace) {
  const nsvcd__needs needs = nsvcd__needs_of(question);
  nsvcd__query *query = (nsvcd__query *)workspace;
  nsvcd__task *task = &query->task;
  (void)nsvcd__query_layout(&needs, (char *)workspace);
  task->swapped = nsvcd__is_swapped(&question->a, &question->b);
  const nsvcd_mover *moving = task->swapped ? &question->b : &question->a;
  const nsvcd_mover *fixed = task->swapped ? &question->a : &question->b;
  nsvcd__motion_init(moving, fixed, &task->motion);
  task->moving = moving->body;
  task->fixed = fixed->body;
  task->lengths = task->motion.scale * task->moving->extent + task->fixed->extent;
  task->method = nsvcd__method_of(task->moving, task->fixed, question->method);
  task->question = question;
#ifndef NSVCD_NO_NETWORK
  task->decisive = NULL;
#endif
  return query;
}

// ---- answer, and write

// What was found out about the moving body and the fixed one, said about b and a.
static void nsvcd__swap_patches(uint32_t *a, uint32_t *b) {
  const uint32_t first = *a;
  *a = *b;
  *b = first;
}
static void nsvcd__swap_contact(nsvcd_contact *contact) {
  nsvcd__swap_patches(&contact->patch_a, &contact->patch_b);
  nsvcd__swap_patches(&contact->triangle_a, &contact->triangle_b);
  const float gap = contact->gap < HUGE_VALF ? contact->gap : 0;
  for (size_t k = 0; k < 3; k++) {
    contact->point[k] += gap * contact->normal[k];
    contact->normal[k] = 0 - contact->normal[k];
  }
}
static void nsvcd__swap_answer(nsvcd_answer *answer) {
  const nsvcd_pose moving = answer->safe.a;
  answer->safe.a = answer->safe.b;
  answer->safe.b = moving;
  nsvcd__swap_patches(&answer->opinion.patch_a, &answer->opinion.patch_b);
  nsvcd__swap_contact(&answer->nearest);
  for (size_t n = 0; n < answer->contact_count; n++) nsvcd__swap_contact(&answer->contacts[n]);
  for (size_t k = 0; k < 3; k++) answer->lift[k] = 0 - answer->lift[k];
}

// Answers a question that has been checked and laid out. hint: NULL, or that of a batch, for the
// network.
static void nsvcd__answer_query(nsvcd__query *query, nsvcd__hint *hint, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  (void)hint;
#ifndef NSVCD_NO_PROOF
  if (task->method == NSVCD_METHOD_PROOF) nsvcd__answer_by_proof(query, answer);
#endif
#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_NETWORK)
  // What a proof has left undecided the network has an opinion on, if no more than yes or no is
  // asked.
  const nsvcd_question *q = task->question;
  const int knows = task->moving->weights_id && task->fixed->weights_id &&
                    !(q->clearance > 0 || q->ask == NSVCD_ASK_DISTANCE || q->skin > 0);
  if (task->method == NSVCD_METHOD_PROOF && answer->verdict == NSVCD_UNDECIDED && knows)
    (void)nsvcd__ask_network(query, NULL, &answer->opinion);
#endif
#ifndef NSVCD_NO_NETWORK
  if (task->method == NSVCD_METHOD_NETWORK) nsvcd__answer_by_network(query, hint, answer);
#endif
  if (task->swapped) nsvcd__swap_answer(answer);
}

// As nsvcd_sweep_batch.
static nsvcd_result nsvcd__sweep_batch(const nsvcd_question *questions, size_t count,
                                       void *workspace, size_t workspace_size,
                                       nsvcd_answer *answers) {
  const nsvcd__hint none = {0, 0, 0, 0};
  nsvcd__hint hint = none;
  int swapped = 0;
  if (count > 0 && (!questions || !answers)) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < count; k++) {
    const nsvcd_result result = nsvcd__check(&questions[k], workspace, workspace_size);
    if (result) return result;
  }
  for (size_t k = 0; k < count; k++) {
    const nsvcd_question *q = &questions[k];
    nsvcd__query *query = nsvcd__query_open(q, workspace);
    // The hint is about patches of the moving body and of the fixed one.
    const int same = k > 0 && q->a.body == q[-1].a.body && q->b.body == q[-1].b.body;
    if (!same || query->task.swapped != swapped) hint = none;
    swapped = query->task.swapped;
    nsvcd__answer_query(query, &hint, &answers[k]);
  }
  return NSVCD_OK;
}

// --------------------------------------------------------------------------------- query/self_test
// In: nothing. Out: does this build reckon as it should?

// As nsvcd_self_test. The place of a body's point (1, 0, 0) at 16 ticks: the body turns by 90
// degrees about z on its way from (4, 0, 0) to (-4, 0, 0), and is seen by one at (1, 2, 3) whose x,
// y, z are y, z, x. Then two triangles that meet, and, as one is lifted, are apart.
static nsvcd_result nsvcd__self_test(void) {
  // or the compiler would reckon instead
  const volatile float half = 0.70710678f;
  const float turn = half;
  const nsvcd_pose path[2] = {{{4, 0, 0}, {0, 0, 0, 1}}, {{-4, 0, 0}, {0, 0, turn, turn}}};
  const nsvcd_pose rest = {{1, 2, 3}, {0.5f, 0.5f, 0.5f, 0.5f}};
  const nsvcd_mover moving = {NULL, path, 2, NULL, 0};
  const nsvcd_mover fixed = {NULL, &rest, 1, NULL, 0};
  float places[3][NSVCD__LANES];
  // in a block: the stack is shared with what comes after it
  {
    nsvcd__motion motion;
    nsvcd__knots knots;
    uint32_t ticks[NSVCD__LANES];
    for (uint32_t l = 0; l < NSVCD__LANES; l++) ticks[l] = l;
    nsvcd__motion_init(&moving, &fixed, &motion);
    nsvcd__motion_set_ticks(&motion, NSVCD__LANES);
    nsvcd__knots_read(&motion, ticks, NSVCD__LANES, &knots);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v_poses at = nsvcd__knots_load(&motion, &knots, l);
      const nsvcd__v_pose seen = nsvcd__v_seen(&motion, &at);
      const nsvcd__v3 arm = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
      const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
      nsvcd__v3_store(places, l, nsvcd__vmat3_apply_add(rotation, arm, seen.position));
    }
  }
  nsvcd__chords chords;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 way = nsvcd__v3_set(nsvcd__f3_of(0, 0, -0.5f));
    nsvcd__chords_store(&chords, l, nsvcd__v3_load(places, l), way, nsvcd__v_set(0.1f));
  }
  int right = 1;
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const double angle = 1.5707963267948966 * (double)l / NSVCD__LANES;
    const double x = 3 - 0.5 * (double)l + cos(angle);
    right &= fabs((double)chords.start[0][l] - (sin(angle) - 2)) < 1e-4;
    right &= fabs((double)chords.start[1][l] + 3) < 1e-4;
    right &= fabs((double)chords.start[2][l] - x) < 1e-4;
  }
  // only two of these chords come within 0.2 of the ninth place
  nsvcd__sphere resting = {{half - 2, -3, half - 1}, 0.1f};
  right &= nsvcd__meet(&chords, resting) == 0x180;
  resting.centre.y += 1;
  right &= nsvcd__meet(&chords, resting) == 0;
#ifndef NSVCD_NO_PROOF
  const double lift = 4 * (double)half;
  const nsvcd__d3 a[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  nsvcd__d3 b[3] = {{0.25, 0.25, -1}, {0.25, 0.25, 1}, {2, 2, 1}};
  right &= !(nsvcd__nearest_of(a, b).square > 0);
  for (size_t k = 0; k < 3; k++) b[k].z += 1 + lift;
  right &= fabs(nsvcd__nearest_of(a, b).square - lift * lift) < 1e-9;
#endif
#ifdef NSVCD_ONE_PATH
  // a product that has been rounded: of one that is fused, 2^-24 would be left
  const volatile float one_up = 1 + 1.0f / 4096;
  const volatile float square = 1 + 1.0f / 2048;
  const float factor = one_up;
  const float left = factor * factor - square;
  right &= !(left > 0);
#endif
  return right ? NSVCD_OK : NSVCD_ERROR_BUILD;
}

// ============================================================= gradient: of the logit by the poses

// -------------------------------------------------------------------------------- gradient/by_pair
// In: the pair that decided an answer. Out: the derivative of its logit by the poses. Reverse mode,
// step by step from the end, over one pair and in scalars; `by_x` is the derivative of the logit by
// x:
//
//   decoder     by the decoder's inputs
//   pair        by the line between the centres, the velocity, and the rotations, over the frame
//               and the facts
//   instants    by the moving body's poses at t_enter, t_exit and in the middle, and by these times
//   contact     from the times to the poses at the ends of the segment in which the balls meet or
//               part
//   poses       from the pose at any time to the caller's poses
//
// The derivative by the pose of a rigid body is a wrench: a force (by a displacement of its origin)
// and a torque (by a small rotation about that). A force f on a point at `arm` from the origin is
// that force, and the torque arm x f.

#ifndef NSVCD_NO_GRADIENT
// The derivative of |a| by a, times `by`. At 0, to rounding, where it has none, it is nothing: the
// mean of all directions.
static nsvcd__f3 nsvcd__by_length(nsvcd__f3 a, float by) {
  const float length = nsvcd__f3_length(a);
  return nsvcd__f3_scale(a, length > 1e-6f ? by / length : 0);
}

// Lane 0 of so many slices, one after the other: out (count).
static void nsvcd__first_lanes(const void *slices, size_t count, void *out) {
  for (size_t k = 0; k < count; k++) {
    nsvcd__v slice;
    float lanes[NSVCD__SLICE];
    memcpy(&slice, (const char *)slices + k * sizeof slice, sizeof slice);
    nsvcd__v_store(lanes, slice);
    memcpy((char *)out + k * sizeof *lanes, lanes, sizeof *lanes);
  }
}
static nsvcd__f3 nsvcd__first_f3(nsvcd__v3 a) {
  nsvcd__f3 out;
  nsvcd__first_lanes(&a, 3, &out);
  return out;
}

// a's part along the unit vector n (or 0), times `along`, and the rest, turned about n by `angle`,
// times `across`. All that commutes with rotations about n is of this kind.
static nsvcd__f3 nsvcd__turned(nsvcd__f3 a, nsvcd__f3 n, float along, float across,
                               float angle) {
  const float c = across * cosf(angle);
  const nsvcd__f3 side = nsvcd__f3_scale(n, across * sinf(angle));
  nsvcd__f3 sum = {0, 0, 0};
  sum = nsvcd__f3_fma(c, a, sum);
  sum = nsvcd__f3_fma((along - c) * nsvcd__f3_dot(n, a), n, sum);
  return nsvcd__f3_add(sum, nsvcd__f3_cross(side, a));
}

// ---- decoder

// The weights of a layer from input i to outputs o .. o + SLICE - 1.
NSVCD__INLINE nsvcd__v nsvcd__weights_at(const nsvcd__layer *layer, size_t i, size_t o) {
#ifndef NSVCD_NO_FLOAT
  return nsvcd__v_load(nsvcd_w_decoder + layer->weights + layer->outputs * i + o);
#else
  const size_t at = 4 * (layer->outputs * (i / 4) + o) + i % 4;
  const int8_t *w = nsvcd_w_decoder_int8 + layer->weights + at;
  const float *scale = nsvcd_w_decoder_scale + layer->first + o;
  float lanes[NSVCD__SLICE];
  for (size_t l = 0; l < NSVCD__SLICE; l++) lanes[l] = (float)w[4 * l] * scale[l];
  return nsvcd__v_load(lanes);
#endif
}

// The derivative of a decoder's logit by its inputs: x, by_x (DECODER_IN). A ReLU's derivative at 0
// is 0.
static NSVCD__APART void nsvcd__decoder_gradient(const nsvcd__decoder *decoder, const float *x,
                                                 float *by_x) {
  // what comes out of the layers, but for the last
  float values[5][NSVCD__WIDEST];
  float by[NSVCD__MOST_INPUTS] = {1};
  const size_t last = decoder->layers - 1;
  for (size_t n = 0; n < last; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    const float *from = n > 0 ? values[n - 1] : x;
    float *y = values[n];
    memcpy(y, nsvcd_w_decoder_bias + layer.first, layer.outputs * sizeof *y);
    for (size_t i = 0; i < layer.inputs; i++) {
      // about half of them
      if (!(from[i] < 0 || from[i] > 0)) continue;
      const nsvcd__v input = nsvcd__v_set(from[i]);
      for (size_t o = 0; o < layer.outputs; o += NSVCD__SLICE) {
        const nsvcd__v w = nsvcd__weights_at(&layer, i, o);
        nsvcd__v_store(y + o, nsvcd__v_fma(input, w, nsvcd__v_load(y + o)));
      }
    }
    for (size_t o = 0; o < layer.outputs; o++) y[o] = y[o] > 0 ? y[o] : 0;
  }
  for (size_t n = last + 1; n-- > 0;) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    float by_inputs[NSVCD__MOST_INPUTS] = {0};
    for (size_t i = 0; i < layer.inputs; i++) {
      if (n > 0 && !(values[n - 1][i] > 0)) continue;
      float lanes[NSVCD__LANES];
      NSVCD__EACH_SLICE(l) {
        nsvcd__v sum = nsvcd__v_set(0);
        for (size_t o = l; o < layer.outputs; o += NSVCD__LANES) {
          const nsvcd__v w = nsvcd__weights_at(&layer, i, o);
          sum = nsvcd__v_fma(w, nsvcd__v_load(by + o), sum);
        }
        nsvcd__v_store(lanes + l, sum);
      }
      for (size_t k = 0; k < NSVCD__LANES; k++) by_inputs[i] += lanes[k];
    }
    memcpy(by, by_inputs, layer.inputs * sizeof *by);
  }
  memcpy(by_x, by, NSVCD__DECODER_IN * sizeof *by_x);
}

// ---- pair

// The derivative by a small rotation of a latent's vectors, as they are (x) and the derivative by
// them (by), both (3, CHANNELS), then (5, CHANNELS). On degree 2, in the basis of nsvcd__degree2, a
// rotation by w adds to q
//   (wy q1 - wx q3 + 2 wz q4, wz q3 - wy q0 - wx (r q2 + q4), r (wx q1 - wy q3),
//    wx q0 - wz q1 + wy (r q2 - q4), wx q1 + wy q3 - 2 wz q0), r being the root of 3.
static nsvcd__f3 nsvcd__latent_torque(const float *x, const float *by) {
  const float r = 1.7320508075688772f;
  nsvcd__f3 torque = {0, 0, 0};
  for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
    float both[2][8];
    for (size_t k = 0; k < 8; k++) {
      both[0][k] = x[NSVCD_W_CHANNELS * k + c];
      both[1][k] = by[NSVCD_W_CHANNELS * k + c];
    }
    const float *q = both[0] + 3;
    const float *h = both[1] + 3;
    const nsvcd__f3 degree1 = nsvcd__f3_cross(nsvcd__f3_load(q - 3), nsvcd__f3_load(h - 3));
    nsvcd__f3 degree2;
    degree2.x = h[3] * q[0] - h[0] * q[3] + r * (h[2] * q[1] - h[1] * q[2]);
    degree2.y = h[0] * q[1] - h[1] * q[0] + r * (h[3] * q[2] - h[2] * q[3]);
    degree2.z = h[1] * q[3] - h[3] * q[1] + 2 * (h[0] * q[4] - h[4] * q[0]);
    degree2.x = degree2.x + h[4] * q[1] - h[1] * q[4];
    degree2.y = degree2.y + h[4] * q[3] - h[3] * q[4];
    torque = nsvcd__f3_add(nsvcd__f3_add(torque, degree1), degree2);
  }
  return torque;
}

// The derivative of a logit by a pair, as nsvcd__pairs has it, in the fixed body's axes and units.
typedef struct nsvcd__by_pair {
  nsvcd__f3 p1, v, w;
  // by a small rotation of the moving patch about its centre
  nsvcd__f3 rotation;
} nsvcd__by_pair;

// A pair in its own units: what nsvcd__views has in lane 0, number by number.
typedef struct nsvcd__view {
  float inverse, k1, k2, swap;
  nsvcd__f3 d, lean, v, w;
  nsvcd__mat3 frame;
  float side;
} nsvcd__view;

// The derivative of a logit by what the frame sees, and the torque on that, in the frame.
typedef struct nsvcd__by_view {
  nsvcd__f3 d, v, w, lean, torque;
} nsvcd__by_view;

// sum + the rows of m, times the components of a.
static nsvcd__f3 nsvcd__add_along_rows(nsvcd__f3 sum, const nsvcd__mat3 *m, nsvcd__f3 a) {
  sum = nsvcd__f3_fma(a.x, m->x, sum);
  sum = nsvcd__f3_fma(a.y, m->y, sum);
  return nsvcd__f3_fma(a.z, m->z, sum);
}

// The adjoint of the facts: by (FACTS), added to `out`.
static void nsvcd__by_facts(const nsvcd__view *view, const float *facts, const float *by,
                            nsvcd__by_view *out) {
  const float tau = facts[NSVCD__FACT_TAU];
  const float scale = 1 / (nsvcd__f3_dot(view->v, view->v) + 1e-6f);
  const nsvcd__f3 closest = nsvcd__f3_sub(view->d, nsvcd__f3_scale(view->v, tau));
  const nsvcd__f3 by_distance = nsvcd__by_length(view->d, by[NSVCD__FACT_DISTANCE]);
  const nsvcd__f3 by_closest = nsvcd__by_length(closest, by[NSVCD__FACT_CLOSEST]);
  out->d = nsvcd__f3_add(out->d, by_distance);
  out->d = nsvcd__f3_add(out->d, by_closest);
  out->v = nsvcd__f3_fma(-tau, by_closest, out->v);
  // else it is clamped
  if (fabsf(tau) < 1) {
    const float direct = by[NSVCD__FACT_TAU];
    const float by_tau = scale * (direct - nsvcd__f3_dot(by_closest, view->v));
    out->d = nsvcd__f3_fma(by_tau, view->v, out->d);
    out->v = nsvcd__f3_fma(by_tau, view->d, out->v);
    out->v = nsvcd__f3_fma(-2 * by_tau * tau, view->v, out->v);
  }

  const nsvcd__f3 velocity = nsvcd__f3_load(facts + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 turn = nsvcd__f3_load(facts + NSVCD__FACT_TURN);
  const nsvcd__f3 by_velocity = nsvcd__f3_load(by + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 by_turn = nsvcd__f3_load(by + NSVCD__FACT_TURN);
  const nsvcd__f3 mirrored = nsvcd__f3_scale(by_turn, view->side);
  out->v = nsvcd__add_along_rows(out->v, &view->frame, by_velocity);
  out->w = nsvcd__add_along_rows(out->w, &view->frame, mirrored);
  out->torque = nsvcd__f3_add(out->torque, nsvcd__f3_cross(velocity, by_velocity));
  out->torque = nsvcd__f3_add(out->torque, nsvcd__f3_cross(turn, by_turn));
  out->v = nsvcd__f3_add(out->v, nsvcd__by_length(view->v, by[NSVCD__FACT_SPEED]));
  out->w = nsvcd__f3_add(out->w, nsvcd__by_length(view->w, by[NSVCD__FACT_SPIN]));
}

// The adjoint of the frame in nsvcd__views_of, whose conventions are constant between its switches,
// added to `by`. Turning the frame does the opposite of turning all that it sees.
static void nsvcd__by_frame(const nsvcd__view *view, nsvcd__by_view *by) {
  const nsvcd__f3 e1 = view->frame.x;
  const nsvcd__f3 e2 = view->frame.y;
  const nsvcd__f3 e3 = view->frame.z;
  const float length = nsvcd__f3_length(view->d);
  const nsvcd__f3 line = nsvcd__f3_of(view->lean.x + 1e-6f, view->lean.y, view->lean.z);

  // Axis 2: of what is across axis 1, of a reference a.
  nsvcd__f3 a = nsvcd__f3_add(nsvcd__f3_scale(view->lean, NSVCD__LEAN), view->v);
  nsvcd__f3 across = nsvcd__f3_sub(a, nsvcd__f3_scale(e1, nsvcd__f3_dot(a, e1)));
  const int vanishes = nsvcd__f3_length(across) <= 1e-7f;
  if (vanishes) {
    // the coordinate axis farthest from e1
    const float x = fabsf(e1.x);
    const float y = fabsf(e1.y);
    const float z = fabsf(e1.z);
    a = y <= z ? nsvcd__f3_of(0, 1, 0) : nsvcd__f3_of(0, 0, 1);
    if (x <= y && x <= z) a = nsvcd__f3_of(1, 0, 0);
    across = nsvcd__f3_sub(a, nsvcd__f3_scale(e1, nsvcd__f3_dot(a, e1)));
  }
  const float about = by->torque.x / nsvcd__f3_length(across);
  if (!vanishes) {
    by->v = nsvcd__f3_fma(-about, e3, by->v);
    by->lean = nsvcd__f3_fma(-about * NSVCD__LEAN, e3, by->lean);
  }

  // Axis 1: of the line, or of what stands for it.
  nsvcd__f3 by_e1 = nsvcd__f3_scale(e3, by->torque.y + about * nsvcd__f3_dot(e1, a));
  by_e1 = nsvcd__f3_fma(-by->torque.z, e2, by_e1);
  if (length > 1e-5f)
    by->d = nsvcd__f3_fma(1 / length, by_e1, by->d);
  else if (nsvcd__f3_length(line) > 1e-9f)
    by->lean = nsvcd__f3_fma(1 / nsvcd__f3_length(line), by_e1, by->lean);
}

// The adjoint of nsvcd__invariants for the pair in lane 0. x, by_x (DECODER_IN). The unit of length
// is constant.
static NSVCD__APART void nsvcd__by_invariants(const nsvcd__pairs *pairs, const float *x,
                                              const float *by_x, nsvcd__by_pair *by) {
  nsvcd__views views;
  nsvcd__view view;
  nsvcd__mat3 rotation;
  nsvcd__views_of(pairs, 1, &views);
  nsvcd__first_lanes(&views, sizeof view / sizeof(float), &view);
  nsvcd__first_lanes(&pairs->rotation, 9, &rotation);
  // Which way time runs. 0 at rest, to rounding: the logit is even in the motion, with a kink
  // there, and the mean of its two sides is 0.
  const float same_v = nsvcd__f3_dot(view.v, nsvcd__first_f3(pairs->v)) * view.inverse;
  const float same = same_v + nsvcd__f3_dot(view.w, nsvcd__first_f3(pairs->w));
  const float sign = fabsf(same) < 1e-12f ? 0.0f : same < 0 ? -1.0f : 1.0f;

  // Torques in the frame: on the moving patch's latent, then on all that the frame sees.
  const size_t facts = 2 * NSVCD__LATENT;
  const size_t first = view.swap > 0 ? 0 : NSVCD__VECTORS;
  const size_t second = NSVCD__VECTORS - first;
  const nsvcd__f3 on_moving = nsvcd__latent_torque(x + first, by_x + first);
  const nsvcd__f3 on_fixed = nsvcd__latent_torque(x + second, by_x + second);
  nsvcd__by_view seen;
  memset(&seen, 0, sizeof seen);
  seen.torque = nsvcd__f3_add(on_moving, on_fixed);
  nsvcd__by_facts(&view, x + facts, by_x + facts, &seen);
  nsvcd__by_frame(&view, &seen);

  const nsvcd__f3 mean = nsvcd__mean_direction(pairs->z[0][0]);
  const nsvcd__f3 scaled = nsvcd__f3_scale(mean, view.swap * view.k1 / 127);
  const nsvcd__f3 lean1 = nsvcd__mat3_apply(&rotation, scaled);
  const nsvcd__f3 none = {0, 0, 0};
  const nsvcd__f3 turned = nsvcd__f3_scale(on_moving, view.side);
  by->rotation = nsvcd__add_along_rows(none, &view.frame, turned);
  by->rotation = nsvcd__f3_add(by->rotation, nsvcd__f3_cross(lean1, seen.lean));
  by->p1 = nsvcd__f3_scale(seen.d, -view.swap * view.inverse);
  by->v = nsvcd__f3_scale(seen.v, sign * view.inverse);
  by->w = nsvcd__f3_scale(seen.w, sign);
}
#endif  // NSVCD_NO_GRADIENT

// ------------------------------------------------------------------------------- gradient/gradient
// In: derivatives by the pair. Out: those by the poses of both movers.

#ifndef NSVCD_NO_GRADIENT
// Adds to a wrench, row (6).
static void nsvcd__wrench_add(nsvcd__f3 force, nsvcd__f3 torque, float *row) {
  nsvcd__f3_store(nsvcd__f3_add(nsvcd__f3_load(row), force), row);
  nsvcd__f3_store(nsvcd__f3_add(nsvcd__f3_load(row + 3), torque), row + 3);
}

// From a force and a torque on a body at time t, in the world, to `gradient` (count, 6), or NULL,
// by its poses before and after t. Returns the derivative by t. With R = exp(2 u h n) A, on the
// shorter arc from A to B = exp(2 h n) A, small rotations a of A and b of B (on the left) turn R
//   along n    by (1 - u) a + u b,
//   across n   by sin((1 - u) h) / sin h of a, turned by u h about n,
//              and sin(u h) / sin h of b, turned by -(1 - u) h.
static float nsvcd__by_poses(const nsvcd__track *track, float t, nsvcd__f3 force,
                             nsvcd__f3 torque, float *gradient) {
  if (track->count == 1) {
    if (gradient) nsvcd__wrench_add(force, torque, gradient);
    return 0;
  }
  float u;
  const size_t k = nsvcd__pose_at(track, t, &u);
  const float *times = track->times;
  const float per_t = times ? 1 / (times[k + 1] - times[k]) : (float)(track->count - 1);
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = &track->poses[k + 1];
  // The turn from a to b on the shorter arc: by 2 h about n, of length 1, or 0 where nothing turns.
  const nsvcd__quat qa = nsvcd__quat_unit(nsvcd__quat_load(a->rotation));
  const nsvcd__quat qb = nsvcd__quat_unit(nsvcd__quat_load(b->rotation));
  const nsvcd__quat nearer = nsvcd__quat_beside(qb, nsvcd__poses_opposed(a, b));
  const nsvcd__f3 axis = nsvcd__quat_turn(qa, nearer);
  const float sine = nsvcd__f3_length(axis);
  const float inverse = sine > 0 ? 1 / sine : 0;
  const nsvcd__f3 n = nsvcd__f3_scale(axis, inverse);
  const float h = nsvcd__quat_arc(qa, nearer);
  if (gradient) {
    const float wa = h > 1e-3f ? sinf((1 - u) * h) * inverse : 1 - u;
    const float wb = h > 1e-3f ? sinf(u * h) * inverse : u;
    const nsvcd__f3 on_a = nsvcd__turned(torque, n, 1 - u, wa, -u * h);
    const nsvcd__f3 on_b = nsvcd__turned(torque, n, u, wb, (1 - u) * h);
    nsvcd__wrench_add(nsvcd__f3_scale(force, 1 - u), on_a, gradient + 6 * k);
    nsvcd__wrench_add(nsvcd__f3_scale(force, u), on_b, gradient + 6 * (k + 1));
  }
  const nsvcd__f3 from = nsvcd__f3_load(a->position);
  const nsvcd__f3 moved = nsvcd__f3_sub(nsvcd__f3_load(b->position), from);
  const float by_turn = 2 * h * nsvcd__f3_dot(torque, n);
  return per_t * (nsvcd__f3_dot(force, moved) + by_turn);
}

// ---- instants and contact

// Times at which the moving patch is looked at.
enum {
  NSVCD__AT_ENTRY = 0,
  NSVCD__AT_EXIT = 1,
  NSVCD__AT_MIDDLE = 2,    // between these two
  NSVCD__ENTRY_BEGIN = 3,  // the ends of the segment in which it enters,
  NSVCD__ENTRY_END = 4,
  NSVCD__EXIT_BEGIN = 5,  // and of that in which it leaves
  NSVCD__EXIT_END = 6,
  NSVCD__INSTANTS = 7
};

// The moving patch at these times, in the fixed body's axes and units.
typedef struct nsvcd__instants {
  float t[NSVCD__INSTANTS];
  // from the body's origin to its centre
  float arm[3][NSVCD__LANES];
  float place[3][NSVCD__LANES];  // its centre
  // does it within the segment? else at one of its ends, and these do not move
  int enters, leaves;
} nsvcd__instants;

// The instants of a candidate. time: of the segments' ends.
static void nsvcd__instants_of(const nsvcd__task *task, const nsvcd__candidate *candidate,
                               const float *time, nsvcd__instants *at) {
  const float t0 = candidate->t_enter;
  const float t1 = candidate->t_exit;
  const nsvcd__motion *motion = &task->motion;
  const nsvcd__f3 own = nsvcd__centre_of(nsvcd__body_patches(task->moving), candidate->moving);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_scale(own, motion->scale));
  size_t a = 0;
  size_t b = 0;
  while (!(t0 < time[a + 1]) && time[a + 1] < 1) a++;
  while (!(t1 <= time[b + 1]) && time[b + 1] < 1) b++;
  const float t[] = {t0, t1, 0.5f * (t0 + t1), time[a], time[a + 1], time[b], time[b + 1]};
  memcpy(at->t, t, sizeof t);
  at->enters = time[a] < t0 && t0 < time[a + 1];
  at->leaves = time[b] < t1 && t1 < time[b + 1];

  for (size_t first = 0; first < NSVCD__INSTANTS; first += NSVCD__SLICE) {
    const size_t left = NSVCD__INSTANTS - first;
    const size_t count = left < NSVCD__SLICE ? left : NSVCD__SLICE;
    const nsvcd__v_pose pose = nsvcd__v_poses_at(motion, t + first, count);
    const nsvcd__v3 arm = nsvcd__vmat3_apply(nsvcd__vmat3_of(pose.rotation), centre);
    nsvcd__v3_store(at->arm, first, arm);
    nsvcd__v3_store(at->place, first, nsvcd__v3_add(arm, pose.position));
  }
}

// From a force on the patch's centre at instant l, and a torque on the moving body, in the fixed
// one's axes and units, to the derivatives by the poses of the moving body and of the fixed one:
// out (2), of which one may be NULL. What is done to one body is done to the other the opposite
// way. Returns the derivative by the time.
static float nsvcd__by_instant(const nsvcd__motion *motion, nsvcd__instants *at, size_t l,
                               nsvcd__f3 force, nsvcd__f3 torque, float *const *out) {
  const float t = at->t[l];
  const float unit = motion->unit;
  const nsvcd__world_pose moving = nsvcd__track_pose_at(&motion->moving, t);
  const nsvcd__world_pose fixed = nsvcd__track_pose_at(&motion->fixed, t);
  const nsvcd__mat3 axes = nsvcd__mat3_of(fixed.rotation);
  const nsvcd__f3 arm = nsvcd__d3_narrow(nsvcd__d3_sub(moving.position, fixed.position));
  const nsvcd__f3 lever = nsvcd__f3_cross(nsvcd__lane_of(at->arm, l), force);
  const nsvcd__f3 seen = nsvcd__mat3_apply(&axes, force);
  const nsvcd__f3 push = nsvcd__f3_of(seen.x / unit, seen.y / unit, seen.z / unit);
  const nsvcd__f3 turn = nsvcd__mat3_apply(&axes, nsvcd__f3_add(torque, lever));
  const nsvcd__f3 back = nsvcd__f3_scale(push, -1);
  const nsvcd__f3 turn_back = nsvcd__f3_sub(nsvcd__f3_cross(arm, back), turn);
  const float by_moving = nsvcd__by_poses(&motion->moving, t, push, turn, out[0]);
  return by_moving + nsvcd__by_poses(&motion->fixed, t, back, turn_back, out[1]);
}

// The adjoint of the time at which the balls meet (AT_ENTRY) or part (AT_EXIT): y = x0 + tau x - c,
// from the chord x of the segment, is as long as the sum of the radii; so y.(dy + x dtau) = 0.
// Balls that only graze (y across x) do so for a time whose derivative has no limit: it is bounded
// where float32 has no digits left.
static void nsvcd__by_contact(const nsvcd__motion *motion, nsvcd__instants *at, size_t l,
                              nsvcd__f3 centre, float by_time, float *const *out) {
  const nsvcd__f3 none = {0, 0, 0};
  const size_t s = l == NSVCD__AT_ENTRY ? NSVCD__ENTRY_BEGIN : NSVCD__EXIT_BEGIN;
  const float length = at->t[s + 1] - at->t[s];
  const nsvcd__f3 start = nsvcd__lane_of(at->place, s);
  const float tau = (at->t[l] - at->t[s]) / length;
  const nsvcd__f3 chord = nsvcd__f3_sub(nsvcd__lane_of(at->place, s + 1), start);
  const nsvcd__f3 from = nsvcd__f3_sub(start, centre);
  const nsvcd__f3 y = nsvcd__f3_fma(tau, chord, from);
  const float least = 1e-3f * nsvcd__f3_length(y) * nsvcd__f3_length(chord);
  const float dot = fabsf(nsvcd__f3_dot(y, chord));
  if (!(least > 0)) return;
  const float along = l == NSVCD__AT_ENTRY ? length : -length;
  const float rate = along * by_time / (dot > least ? dot : least);
  const nsvcd__f3 before = nsvcd__f3_scale(y, (1 - tau) * rate);
  const nsvcd__f3 after = nsvcd__f3_scale(y, tau * rate);
  nsvcd__by_instant(motion, at, s, before, none, out);
  nsvcd__by_instant(motion, at, s + 1, after, none, out);
}

// The derivative of the decisive logit by the poses, added to the gradients. time: of the segments'
// ends.
static void nsvcd__gradient(const nsvcd__task *task, const nsvcd__decisive *decisive,
                            const float *time, float *const *out) {
  const nsvcd__motion *motion = &task->motion;
  nsvcd__candidate candidate = decisive->candidate;
  nsvcd__candidate *one = &candidate;
  nsvcd__pairs pairs;
  nsvcd__by_pair by;
  nsvcd__instants at;
  float x[NSVCD__DECODER_IN];
  float by_x[NSVCD__DECODER_IN];
  nsvcd__pairs_of(task->moving, task->fixed, motion, &one, 1, &pairs);
  nsvcd__invariants(&pairs, 1, x);
  nsvcd__decoder_gradient(decisive->decoder, x, by_x);
  nsvcd__by_invariants(&pairs, x, by_x, &by);
  nsvcd__instants_of(task, &candidate, time, &at);

  // The adjoint of nsvcd__pairs_of. v = w x arm + (x1 - x0) / 2, where arm goes from the moving
  // centre half way to the other.
  const nsvcd__f3 w = nsvcd__first_f3(pairs.w);
  const nsvcd__f3 centre = nsvcd__first_f3(pairs.p2);
  const nsvcd__f3 line = nsvcd__f3_sub(centre, nsvcd__lane_of(at.place, NSVCD__AT_MIDDLE));
  const nsvcd__f3 arm = nsvcd__f3_scale(line, 0.5f);
  const nsvcd__f3 p1 = nsvcd__f3_fma(-0.5f, nsvcd__f3_cross(by.v, w), by.p1);
  const nsvcd__f3 turn = nsvcd__f3_add(by.w, nsvcd__f3_cross(arm, by.v));
  // w is half the rotation vector of R1 R0^-1: small rotations of R0 and R1 turn it as
  // nsvcd__by_poses says.
  const nsvcd__f3 none = {0, 0, 0};
  float by_time[2];
  const float h = nsvcd__f3_length(w);
  const float half = 0.5f * (h > 1e-3f ? h / sinf(h) : 1);
  const nsvcd__f3 n = h > 0 ? nsvcd__f3_of(w.x / h, w.y / h, w.z / h) : none;
  const float by_middle =
      nsvcd__by_instant(motion, &at, NSVCD__AT_MIDDLE, p1, by.rotation, out);
  for (size_t l = NSVCD__AT_ENTRY; l <= NSVCD__AT_EXIT; l++) {
    const float side = l == NSVCD__AT_ENTRY ? -1.0f : 1.0f;
    const nsvcd__f3 force = nsvcd__f3_scale(by.v, 0.5f * side);
    const nsvcd__f3 torque = nsvcd__turned(turn, n, 0.5f * side, half * side, h * side);
    by_time[l] = 0.5f * by_middle + nsvcd__by_instant(motion, &at, l, force, torque, out);
  }
  if (at.enters) nsvcd__by_contact(motion, &at, NSVCD__AT_ENTRY, centre, by_time[0], out);
  if (at.leaves) nsvcd__by_contact(motion, &at, NSVCD__AT_EXIT, centre, by_time[1], out);
}

// As nsvcd_sweep_gradient.
static nsvcd_result nsvcd__sweep_gradient(const nsvcd_question *question, void *workspace,
                                          size_t workspace_size, nsvcd_answer *answer,
                                          float *gradient_a, float *gradient_b) {
  if (!question || !answer || (!gradient_a && !gradient_b)) return NSVCD_ERROR_ARGUMENT;
  if (question->method == NSVCD_METHOD_PROOF) return NSVCD_ERROR_ARGUMENT;
  nsvcd_question by_network = *question;
  by_network.method = NSVCD_METHOD_NETWORK;
  const nsvcd_result result = nsvcd__check(&by_network, workspace, workspace_size);
  if (result) return result;
  nsvcd__query *query = nsvcd__query_open(&by_network, workspace);
  nsvcd__task *task = &query->task;
  nsvcd__decisive decisive;
  task->decisive = &decisive;
  nsvcd__answer_query(query, NULL, answer);
  float *const out[2] = {task->swapped ? gradient_b : gradient_a,
                         task->swapped ? gradient_a : gradient_b};
  if (out[0]) memset(out[0], 0, 6 * task->motion.moving.count * sizeof(float));
  if (out[1]) memset(out[1], 0, 6 * task->motion.fixed.count * sizeof(float));
  if (answer->by == NSVCD_BY_NETWORK && !answer->inside)
    nsvcd__gradient(task, &decisive, query->broad_phase.time, out);
  return NSVCD_OK;
}
#endif  // NSVCD_NO_GRADIENT

#ifndef NSVCD__ISA
// ==================================================================== entry: the processor decides

// --------------------------------------------------------------------------------- entry/processor
// In: a question. Out: its answer, by the functions for the best vectors that the processor has.
//
// Where the compiler's flags allow SSE2 and no more, the default on x86-64, all that a query does
// is compiled three times: with SSE2 above, and here with AVX2 and with AVX-512. At each call the
// processor at hand decides which of them answers. NSVCD_NO_DISPATCH leaves the first only.
//
// This file takes itself in for that. Of it only the rooms that use vectors are compiled again.
// Their private names are changed: nsvcd__prove is nsvcd__prove_avx2 there.

#if NSVCD__SLICE == 4 && !defined(NSVCD_NO_DISPATCH) && !defined(NSVCD__NARROW)
#if defined(__x86_64__) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 8))
#define NSVCD__DISPATCH
#elif defined(_M_X64) && !defined(__clang__)
#include <intrin.h>
#define NSVCD__DISPATCH
#endif
#endif

#ifdef NSVCD__DISPATCH
#define NSVCD__JOIN(name, isa) name##isa
#define NSVCD__OF_ISA(name, isa) NSVCD__JOIN(name, isa)
#define NSVCD__AT(name) NSVCD__OF_ISA(nsvcd__##name, NSVCD__ISA)
#define NSVCD__NUMBER_AT(name) NSVCD__OF_ISA(NSVCD__##name, NSVCD__ISA)

// ---- the names, as src/make_header.py writes them
#define NSVCD__ANSWERED NSVCD__NUMBER_AT(ANSWERED)
#define NSVCD__AT_ENTRY NSVCD__NUMBER_AT(AT_ENTRY)
#define NSVCD__AT_EXIT NSVCD__NUMBER_AT(AT_EXIT)
#define NSVCD__AT_MIDDLE NSVCD__NUMBER_AT(AT_MIDDLE)
#define NSVCD__BY_DISC NSVCD__NUMBER_AT(BY_DISC)
#define NSVCD__BY_HULL NSVCD__NUMBER_AT(BY_HULL)
#define NSVCD__BY_TRIANGLES NSVCD__NUMBER_AT(BY_TRIANGLES)
#define NSVCD__CONTACTS NSVCD__NUMBER_AT(CONTACTS)
#define NSVCD__ENTRY_BEGIN NSVCD__NUMBER_AT(ENTRY_BEGIN)
#define NSVCD__ENTRY_END NSVCD__NUMBER_AT(ENTRY_END)
#define NSVCD__EXIT_BEGIN NSVCD__NUMBER_AT(EXIT_BEGIN)
#define NSVCD__EXIT_END NSVCD__NUMBER_AT(EXIT_END)
#define NSVCD__FACTS NSVCD__NUMBER_AT(FACTS)
#define NSVCD__FACT_CLOSEST NSVCD__NUMBER_AT(FACT_CLOSEST)
#define NSVCD__FACT_DISTANCE NSVCD__NUMBER_AT(FACT_DISTANCE)
#define NSVCD__FACT_RADIUS NSVCD__NUMBER_AT(FACT_RADIUS)
#define NSVCD__FACT_SPEED NSVCD__NUMBER_AT(FACT_SPEED)
#define NSVCD__FACT_SPIN NSVCD__NUMBER_AT(FACT_SPIN)
#define NSVCD__FACT_TAU NSVCD__NUMBER_AT(FACT_TAU)
#define NSVCD__FACT_TURN NSVCD__NUMBER_AT(FACT_TURN)
#define NSVCD__FACT_VELOCITY NSVCD__NUMBER_AT(FACT_VELOCITY)
#define NSVCD__FREE NSVCD__NUMBER_AT(FREE)
#define NSVCD__INSTANTS NSVCD__NUMBER_AT(INSTANTS)
#define NSVCD__MEETS NSVCD__NUMBER_AT(MEETS)
#define NSVCD__NOTHING NSVCD__NUMBER_AT(NOTHING)
#define NSVCD__SETTLED NSVCD__NUMBER_AT(SETTLED)
#define NSVCD__SHRUNK NSVCD__NUMBER_AT(SHRUNK)
#define NSVCD__SPENT NSVCD__NUMBER_AT(SPENT)
#define NSVCD__SUPPORTING NSVCD__NUMBER_AT(SUPPORTING)
#define NSVCD__TOO_LONG NSVCD__NUMBER_AT(TOO_LONG)
#define NSVCD__TOUCHING NSVCD__NUMBER_AT(TOUCHING)
#define NSVCD__UNDECIDED NSVCD__NUMBER_AT(UNDECIDED)
#define NSVCD__WITHIN NSVCD__NUMBER_AT(WITHIN)
#define nsvcd__across_edges NSVCD__AT(across_edges)
#define nsvcd__add_along_rows NSVCD__AT(add_along_rows)
#define nsvcd__add_dipoles NSVCD__AT(add_dipoles)
#define nsvcd__against NSVCD__AT(against)
#define nsvcd__all_segments NSVCD__AT(all_segments)
#define nsvcd__answer_begin NSVCD__AT(answer_begin)
#define nsvcd__answer_by_network NSVCD__AT(answer_by_network)
#define nsvcd__answer_by_proof NSVCD__AT(answer_by_proof)
#define nsvcd__answer_query NSVCD__AT(answer_query)
#define nsvcd__answer_with NSVCD__AT(answer_with)
#define nsvcd__arc NSVCD__AT(arc)
#define nsvcd__arc_at NSVCD__AT(arc_at)
#define nsvcd__arc_limit NSVCD__AT(arc_limit)
#define nsvcd__arc_of NSVCD__AT(arc_of)
#define nsvcd__are_opposed NSVCD__AT(are_opposed)
#define nsvcd__ask_network NSVCD__AT(ask_network)
#define nsvcd__asked NSVCD__AT(asked)
#define nsvcd__at_origin NSVCD__AT(at_origin)
#define nsvcd__begin_places NSVCD__AT(begin_places)
#define nsvcd__bends NSVCD__AT(bends)
#define nsvcd__best_lift NSVCD__AT(best_lift)
#define nsvcd__block NSVCD__AT(block)
#define nsvcd__block_bounds NSVCD__AT(block_bounds)
#define nsvcd__block_box NSVCD__AT(block_box)
#define nsvcd__block_corners NSVCD__AT(block_corners)
#define nsvcd__block_lanes NSVCD__AT(block_lanes)
#define nsvcd__block_load NSVCD__AT(block_load)
#define nsvcd__block_pose NSVCD__AT(block_pose)
#define nsvcd__bound_of NSVCD__AT(bound_of)
#define nsvcd__box_of_lane NSVCD__AT(box_of_lane)
#define nsvcd__boxes NSVCD__AT(boxes)
#define nsvcd__boxes_of_groups NSVCD__AT(boxes_of_groups)
#define nsvcd__by_contact NSVCD__AT(by_contact)
#define nsvcd__by_facts NSVCD__AT(by_facts)
#define nsvcd__by_frame NSVCD__AT(by_frame)
#define nsvcd__by_instant NSVCD__AT(by_instant)
#define nsvcd__by_invariants NSVCD__AT(by_invariants)
#define nsvcd__by_length NSVCD__AT(by_length)
#define nsvcd__by_pair NSVCD__AT(by_pair)
#define nsvcd__by_poses NSVCD__AT(by_poses)
#define nsvcd__by_view NSVCD__AT(by_view)
#define nsvcd__candidate NSVCD__AT(candidate)
#define nsvcd__candidates NSVCD__AT(candidates)
#define nsvcd__candidates_add NSVCD__AT(candidates_add)
#define nsvcd__candidates_start NSVCD__AT(candidates_start)
#define nsvcd__certain_opinion NSVCD__AT(certain_opinion)
#define nsvcd__certify_block NSVCD__AT(certify_block)
#define nsvcd__certify_couple NSVCD__AT(certify_couple)
#define nsvcd__certify_disc NSVCD__AT(certify_disc)
#define nsvcd__certify_groups NSVCD__AT(certify_groups)
#define nsvcd__certify_item NSVCD__AT(certify_item)
#define nsvcd__changes_sides NSVCD__AT(changes_sides)
#define nsvcd__check NSVCD__AT(check)
#define nsvcd__choose_four NSVCD__AT(choose_four)
#define nsvcd__choose_lifts NSVCD__AT(choose_lifts)
#define nsvcd__choose_segments NSVCD__AT(choose_segments)
#define nsvcd__chords NSVCD__AT(chords)
#define nsvcd__chords_in_all NSVCD__AT(chords_in_all)
#define nsvcd__chords_in_segment NSVCD__AT(chords_in_segment)
#define nsvcd__chords_of_group NSVCD__AT(chords_of_group)
#define nsvcd__chords_of_members NSVCD__AT(chords_of_members)
#define nsvcd__chords_of_sphere NSVCD__AT(chords_of_sphere)
#define nsvcd__chords_of_tile NSVCD__AT(chords_of_tile)
#define nsvcd__chords_start NSVCD__AT(chords_start)
#define nsvcd__chords_store NSVCD__AT(chords_store)
#define nsvcd__chords_way NSVCD__AT(chords_way)
#define nsvcd__clamp01 NSVCD__AT(clamp01)
#define nsvcd__clamp_share NSVCD__AT(clamp_share)
#define nsvcd__clear_until NSVCD__AT(clear_until)
#define nsvcd__clearance NSVCD__AT(clearance)
#define nsvcd__clip_segment NSVCD__AT(clip_segment)
#define nsvcd__collect_items NSVCD__AT(collect_items)
#define nsvcd__collides_again NSVCD__AT(collides_again)
#define nsvcd__comes_near NSVCD__AT(comes_near)
#define nsvcd__comes_within NSVCD__AT(comes_within)
#define nsvcd__constants_hold NSVCD__AT(constants_hold)
#define nsvcd__contact NSVCD__AT(contact)
#define nsvcd__contact_at NSVCD__AT(contact_at)
#define nsvcd__corners_of NSVCD__AT(corners_of)
#define nsvcd__couple NSVCD__AT(couple)
#define nsvcd__couple_nearest NSVCD__AT(couple_nearest)
#define nsvcd__couple_of NSVCD__AT(couple_of)
#define nsvcd__couple_passes NSVCD__AT(couple_passes)
#define nsvcd__crossings NSVCD__AT(crossings)
#define nsvcd__cut NSVCD__AT(cut)
#define nsvcd__cut_arc NSVCD__AT(cut_arc)
#define nsvcd__cut_block NSVCD__AT(cut_block)
#define nsvcd__cut_deviations NSVCD__AT(cut_deviations)
#define nsvcd__cut_double_arc NSVCD__AT(cut_double_arc)
#define nsvcd__cut_ends NSVCD__AT(cut_ends)
#define nsvcd__cut_knot NSVCD__AT(cut_knot)
#define nsvcd__cut_motion NSVCD__AT(cut_motion)
#define nsvcd__cut_segments NSVCD__AT(cut_segments)
#define nsvcd__cut_starts NSVCD__AT(cut_starts)
#define nsvcd__decisive NSVCD__AT(decisive)
#define nsvcd__decode NSVCD__AT(decode)
#define nsvcd__decoder_by_bytes NSVCD__AT(decoder_by_bytes)
#define nsvcd__decoder_by_floats NSVCD__AT(decoder_by_floats)
#define nsvcd__decoder_gradient NSVCD__AT(decoder_gradient)
#define nsvcd__decoder_logits NSVCD__AT(decoder_logits)
#define nsvcd__deepen NSVCD__AT(deepen)
#define nsvcd__deviation NSVCD__AT(deviation)
#define nsvcd__discs_meet NSVCD__AT(discs_meet)
#define nsvcd__dot_tile NSVCD__AT(dot_tile)
#define nsvcd__edges_cross NSVCD__AT(edges_cross)
#define nsvcd__edges_nearest NSVCD__AT(edges_nearest)
#define nsvcd__encloses_any NSVCD__AT(encloses_any)
#define nsvcd__encloses_seeds NSVCD__AT(encloses_seeds)
#define nsvcd__enclosure NSVCD__AT(enclosure)
#define nsvcd__end_of NSVCD__AT(end_of)
#define nsvcd__exists NSVCD__AT(exists)
#define nsvcd__f3_towards NSVCD__AT(f3_towards)
#define nsvcd__face_direction NSVCD__AT(face_direction)
#define nsvcd__face_normal NSVCD__AT(face_normal)
#define nsvcd__facet_vertices NSVCD__AT(facet_vertices)
#define nsvcd__find_witness NSVCD__AT(find_witness)
#define nsvcd__find_witness_in NSVCD__AT(find_witness_in)
#define nsvcd__first_f3 NSVCD__AT(first_f3)
#define nsvcd__first_lanes NSVCD__AT(first_lanes)
#define nsvcd__foot_well_within NSVCD__AT(foot_well_within)
#define nsvcd__foot_within NSVCD__AT(foot_within)
#define nsvcd__forget NSVCD__AT(forget)
#define nsvcd__gap_after NSVCD__AT(gap_after)
#define nsvcd__gather_contact NSVCD__AT(gather_contact)
#define nsvcd__gather_items NSVCD__AT(gather_items)
#define nsvcd__gather_places NSVCD__AT(gather_places)
#define nsvcd__gathering NSVCD__AT(gathering)
#define nsvcd__gathers_on NSVCD__AT(gathers_on)
#define nsvcd__given NSVCD__AT(given)
#define nsvcd__gradient NSVCD__AT(gradient)
#define nsvcd__group_against_members NSVCD__AT(group_against_members)
#define nsvcd__group_reach NSVCD__AT(group_reach)
#define nsvcd__groups_nearest NSVCD__AT(groups_nearest)
#define nsvcd__guess_clearance NSVCD__AT(guess_clearance)
#define nsvcd__hair NSVCD__AT(hair)
#define nsvcd__height NSVCD__AT(height)
#define nsvcd__held_again NSVCD__AT(held_again)
#define nsvcd__hint NSVCD__AT(hint)
#define nsvcd__hull_of NSVCD__AT(hull_of)
#define nsvcd__hulls_are_apart NSVCD__AT(hulls_are_apart)
#define nsvcd__id_of NSVCD__AT(id_of)
#define nsvcd__inputs_in NSVCD__AT(inputs_in)
#define nsvcd__instants NSVCD__AT(instants)
#define nsvcd__instants_of NSVCD__AT(instants_of)
#define nsvcd__interval_cuts NSVCD__AT(interval_cuts)
#define nsvcd__intervals NSVCD__AT(intervals)
#define nsvcd__intervals_close NSVCD__AT(intervals_close)
#define nsvcd__invariants NSVCD__AT(invariants)
#define nsvcd__inverse_placement NSVCD__AT(inverse_placement)
#define nsvcd__is_approached NSVCD__AT(is_approached)
#define nsvcd__is_around NSVCD__AT(is_around)
#define nsvcd__is_before NSVCD__AT(is_before)
#define nsvcd__is_clear NSVCD__AT(is_clear)
#define nsvcd__is_contained NSVCD__AT(is_contained)
#define nsvcd__is_deep NSVCD__AT(is_deep)
#define nsvcd__is_enclosed NSVCD__AT(is_enclosed)
#define nsvcd__is_harmless NSVCD__AT(is_harmless)
#define nsvcd__is_inside NSVCD__AT(is_inside)
#define nsvcd__is_large NSVCD__AT(is_large)
#define nsvcd__is_new NSVCD__AT(is_new)
#define nsvcd__is_on_ray NSVCD__AT(is_on_ray)
#define nsvcd__is_shallower NSVCD__AT(is_shallower)
#define nsvcd__is_spent NSVCD__AT(is_spent)
#define nsvcd__is_straight NSVCD__AT(is_straight)
#define nsvcd__is_swapped NSVCD__AT(is_swapped)
#define nsvcd__is_tiled NSVCD__AT(is_tiled)
#define nsvcd__is_within NSVCD__AT(is_within)
#define nsvcd__item NSVCD__AT(item)
#define nsvcd__item_is_parted NSVCD__AT(item_is_parted)
#define nsvcd__judge NSVCD__AT(judge)
#define nsvcd__keep_nearer NSVCD__AT(keep_nearer)
#define nsvcd__keep_place NSVCD__AT(keep_place)
#define nsvcd__knots NSVCD__AT(knots)
#define nsvcd__knots_keep NSVCD__AT(knots_keep)
#define nsvcd__knots_load NSVCD__AT(knots_load)
#define nsvcd__knots_read NSVCD__AT(knots_read)
#define nsvcd__known NSVCD__AT(known)
#define nsvcd__lane_of NSVCD__AT(lane_of)
#define nsvcd__lane_set NSVCD__AT(lane_set)
#define nsvcd__lanes_left_by_last NSVCD__AT(lanes_left_by_last)
#define nsvcd__lanes_near NSVCD__AT(lanes_near)
#define nsvcd__lanes_of_slice NSVCD__AT(lanes_of_slice)
#define nsvcd__lanes_on_ray NSVCD__AT(lanes_on_ray)
#define nsvcd__latent_torque NSVCD__AT(latent_torque)
#define nsvcd__layer NSVCD__AT(layer)
#define nsvcd__layer_by_bytes NSVCD__AT(layer_by_bytes)
#define nsvcd__layer_of NSVCD__AT(layer_of)
#define nsvcd__layer_tile NSVCD__AT(layer_tile)
#define nsvcd__least_of NSVCD__AT(least_of)
#define nsvcd__left_by_last NSVCD__AT(left_by_last)
#define nsvcd__leg NSVCD__AT(leg)
#define nsvcd__leg_at NSVCD__AT(leg_at)
#define nsvcd__leg_init NSVCD__AT(leg_init)
#define nsvcd__leg_turn NSVCD__AT(leg_turn)
#define nsvcd__lift_along NSVCD__AT(lift_along)
#define nsvcd__lift_motion NSVCD__AT(lift_motion)
#define nsvcd__lift_off NSVCD__AT(lift_off)
#define nsvcd__lift_still NSVCD__AT(lift_still)
#define nsvcd__limit_after NSVCD__AT(limit_after)
#define nsvcd__limit_of_first NSVCD__AT(limit_of_first)
#define nsvcd__look_across NSVCD__AT(look_across)
#define nsvcd__manifold NSVCD__AT(manifold)
#define nsvcd__margin_along NSVCD__AT(margin_along)
#define nsvcd__mat3_lane NSVCD__AT(mat3_lane)
#define nsvcd__matters NSVCD__AT(matters)
#define nsvcd__may_be_close NSVCD__AT(may_be_close)
#define nsvcd__mean_direction NSVCD__AT(mean_direction)
#define nsvcd__measure NSVCD__AT(measure)
#define nsvcd__measure_once NSVCD__AT(measure_once)
#define nsvcd__measure_turn NSVCD__AT(measure_turn)
#define nsvcd__meet NSVCD__AT(meet)
#define nsvcd__meet_in NSVCD__AT(meet_in)
#define nsvcd__meet_members NSVCD__AT(meet_members)
#define nsvcd__meets_at NSVCD__AT(meets_at)
#define nsvcd__members_against_patch NSVCD__AT(members_against_patch)
#define nsvcd__memo NSVCD__AT(memo)
#define nsvcd__method_of NSVCD__AT(method_of)
#define nsvcd__motion NSVCD__AT(motion)
#define nsvcd__motion_gap NSVCD__AT(motion_gap)
#define nsvcd__motion_init NSVCD__AT(motion_init)
#define nsvcd__motion_pose NSVCD__AT(motion_pose)
#define nsvcd__motion_retime NSVCD__AT(motion_retime)
#define nsvcd__motion_set_ticks NSVCD__AT(motion_set_ticks)
#define nsvcd__motion_set_times NSVCD__AT(motion_set_times)
#define nsvcd__motion_set_tracks NSVCD__AT(motion_set_tracks)
#define nsvcd__mover_check NSVCD__AT(mover_check)
#define nsvcd__moving_block_load NSVCD__AT(moving_block_load)
#define nsvcd__nearby NSVCD__AT(nearby)
#define nsvcd__nearest NSVCD__AT(nearest)
#define nsvcd__nearest2 NSVCD__AT(nearest2)
#define nsvcd__nearest_of NSVCD__AT(nearest_of)
#define nsvcd__nearest_tick NSVCD__AT(nearest_tick)
#define nsvcd__needs NSVCD__AT(needs)
#define nsvcd__needs_of NSVCD__AT(needs_of)
#define nsvcd__network_constants_hold NSVCD__AT(network_constants_hold)
#define nsvcd__next_knot NSVCD__AT(next_knot)
#define nsvcd__next_pose NSVCD__AT(next_pose)
#define nsvcd__normal_to_try NSVCD__AT(normal_to_try)
#define nsvcd__normals_part NSVCD__AT(normals_part)
#define nsvcd__not_parted NSVCD__AT(not_parted)
#define nsvcd__note_depth NSVCD__AT(note_depth)
#define nsvcd__outcome NSVCD__AT(outcome)
#define nsvcd__pairs NSVCD__AT(pairs)
#define nsvcd__pairs_in_passing NSVCD__AT(pairs_in_passing)
#define nsvcd__pairs_of NSVCD__AT(pairs_of)
#define nsvcd__part_groups NSVCD__AT(part_groups)
#define nsvcd__passage NSVCD__AT(passage)
#define nsvcd__patch_reach NSVCD__AT(patch_reach)
#define nsvcd__patch_towards NSVCD__AT(patch_towards)
#define nsvcd__place_point NSVCD__AT(place_point)
#define nsvcd__place_triangle NSVCD__AT(place_triangle)
#define nsvcd__placed NSVCD__AT(placed)
#define nsvcd__placed_at NSVCD__AT(placed_at)
#define nsvcd__placement NSVCD__AT(placement)
#define nsvcd__placement_at NSVCD__AT(placement_at)
#define nsvcd__plane_parts NSVCD__AT(plane_parts)
#define nsvcd__pose_at NSVCD__AT(pose_at)
#define nsvcd__pose_before NSVCD__AT(pose_before)
#define nsvcd__pose_count NSVCD__AT(pose_count)
#define nsvcd__pose_members NSVCD__AT(pose_members)
#define nsvcd__pose_of NSVCD__AT(pose_of)
#define nsvcd__poses_are_valid NSVCD__AT(poses_are_valid)
#define nsvcd__poses_at NSVCD__AT(poses_at)
#define nsvcd__poses_check NSVCD__AT(poses_check)
#define nsvcd__poses_opposed NSVCD__AT(poses_opposed)
#define nsvcd__proof NSVCD__AT(proof)
#define nsvcd__proof_begin NSVCD__AT(proof_begin)
#define nsvcd__proof_constants_hold NSVCD__AT(proof_constants_hold)
#define nsvcd__proof_restart NSVCD__AT(proof_restart)
#define nsvcd__prove NSVCD__AT(prove)
#define nsvcd__prove_and_look NSVCD__AT(prove_and_look)
#define nsvcd__prove_anew NSVCD__AT(prove_anew)
#define nsvcd__prove_by_time NSVCD__AT(prove_by_time)
#define nsvcd__prove_first NSVCD__AT(prove_first)
#define nsvcd__prove_motion NSVCD__AT(prove_motion)
#define nsvcd__prove_segments NSVCD__AT(prove_segments)
#define nsvcd__prove_tiles NSVCD__AT(prove_tiles)
#define nsvcd__quanta_of NSVCD__AT(quanta_of)
#define nsvcd__query NSVCD__AT(query)
#define nsvcd__query_layout NSVCD__AT(query_layout)
#define nsvcd__query_open NSVCD__AT(query_open)
#define nsvcd__question_check NSVCD__AT(question_check)
#define nsvcd__ray NSVCD__AT(ray)
#define nsvcd__ray_crosses NSVCD__AT(ray_crosses)
#define nsvcd__remember_plane NSVCD__AT(remember_plane)
#define nsvcd__rest_at NSVCD__AT(rest_at)
#define nsvcd__rotate_degree NSVCD__AT(rotate_degree)
#define nsvcd__rotate_latent NSVCD__AT(rotate_latent)
#define nsvcd__row_left NSVCD__AT(row_left)
#define nsvcd__scale_of NSVCD__AT(scale_of)
#define nsvcd__scenes NSVCD__AT(scenes)
#define nsvcd__scenes_of NSVCD__AT(scenes_of)
#define nsvcd__score NSVCD__AT(score)
#define nsvcd__search NSVCD__AT(search)
#define nsvcd__search_and_judge NSVCD__AT(search_and_judge)
#define nsvcd__search_begin NSVCD__AT(search_begin)
#define nsvcd__search_group NSVCD__AT(search_group)
#define nsvcd__search_layout NSVCD__AT(search_layout)
#define nsvcd__search_moving_tile NSVCD__AT(search_moving_tile)
#define nsvcd__search_next_tile NSVCD__AT(search_next_tile)
#define nsvcd__search_patch NSVCD__AT(search_patch)
#define nsvcd__search_step NSVCD__AT(search_step)
#define nsvcd__search_tile NSVCD__AT(search_tile)
#define nsvcd__see_to_items NSVCD__AT(see_to_items)
#define nsvcd__seeds_near NSVCD__AT(seeds_near)
#define nsvcd__seek_item NSVCD__AT(seek_item)
#define nsvcd__seek_places NSVCD__AT(seek_places)
#define nsvcd__segment_count NSVCD__AT(segment_count)
#define nsvcd__segment_span NSVCD__AT(segment_span)
#define nsvcd__segments NSVCD__AT(segments)
#define nsvcd__segments_in NSVCD__AT(segments_in)
#define nsvcd__segments_that_matter NSVCD__AT(segments_that_matter)
#define nsvcd__self_test NSVCD__AT(self_test)
#define nsvcd__set_down NSVCD__AT(set_down)
#define nsvcd__settings NSVCD__AT(settings)
#define nsvcd__settings_of NSVCD__AT(settings_of)
#define nsvcd__settle_couple NSVCD__AT(settle_couple)
#define nsvcd__settle_doubt NSVCD__AT(settle_doubt)
#define nsvcd__settle_item NSVCD__AT(settle_item)
#define nsvcd__settle_items NSVCD__AT(settle_items)
#define nsvcd__settle_row NSVCD__AT(settle_row)
#define nsvcd__settle_short_part NSVCD__AT(settle_short_part)
#define nsvcd__settle_straight NSVCD__AT(settle_straight)
#define nsvcd__settle_triangles NSVCD__AT(settle_triangles)
#define nsvcd__share_of NSVCD__AT(share_of)
#define nsvcd__sift_items NSVCD__AT(sift_items)
#define nsvcd__slice_against_patch NSVCD__AT(slice_against_patch)
#define nsvcd__sort_items NSVCD__AT(sort_items)
#define nsvcd__span NSVCD__AT(span)
#define nsvcd__span_of_arc NSVCD__AT(span_of_arc)
#define nsvcd__span_of_segment NSVCD__AT(span_of_segment)
#define nsvcd__spanned NSVCD__AT(spanned)
#define nsvcd__spare_boxes NSVCD__AT(spare_boxes)
#define nsvcd__spare_chords NSVCD__AT(spare_chords)
#define nsvcd__spheres_at_box NSVCD__AT(spheres_at_box)
#define nsvcd__squares_in_radii NSVCD__AT(squares_in_radii)
#define nsvcd__starts_inside NSVCD__AT(starts_inside)
#define nsvcd__starts_within NSVCD__AT(starts_within)
#define nsvcd__sticks_out NSVCD__AT(sticks_out)
#define nsvcd__support NSVCD__AT(support)
#define nsvcd__support_along NSVCD__AT(support_along)
#define nsvcd__surface_is_near NSVCD__AT(surface_is_near)
#define nsvcd__surroundings NSVCD__AT(surroundings)
#define nsvcd__swap_answer NSVCD__AT(swap_answer)
#define nsvcd__swap_contact NSVCD__AT(swap_contact)
#define nsvcd__swap_patches NSVCD__AT(swap_patches)
#define nsvcd__sweep_batch NSVCD__AT(sweep_batch)
#define nsvcd__sweep_gradient NSVCD__AT(sweep_gradient)
#define nsvcd__sweep_size NSVCD__AT(sweep_size)
#define nsvcd__take_contact NSVCD__AT(take_contact)
#define nsvcd__take_doubt NSVCD__AT(take_doubt)
#define nsvcd__take_to_line NSVCD__AT(take_to_line)
#define nsvcd__takes_lift NSVCD__AT(takes_lift)
#define nsvcd__task NSVCD__AT(task)
#define nsvcd__tell_contact NSVCD__AT(tell_contact)
#define nsvcd__tell_manifold NSVCD__AT(tell_manifold)
#define nsvcd__tell_safe_place NSVCD__AT(tell_safe_place)
#define nsvcd__tick_of NSVCD__AT(tick_of)
#define nsvcd__tile NSVCD__AT(tile)
#define nsvcd__tile_fill NSVCD__AT(tile_fill)
#define nsvcd__tile_fill_all NSVCD__AT(tile_fill_all)
#define nsvcd__time_in_arc NSVCD__AT(time_in_arc)
#define nsvcd__time_in_segment NSVCD__AT(time_in_segment)
#define nsvcd__time_of NSVCD__AT(time_of)
#define nsvcd__times_are_valid NSVCD__AT(times_are_valid)
#define nsvcd__to_of NSVCD__AT(to_of)
#define nsvcd__to_world NSVCD__AT(to_world)
#define nsvcd__to_world_at NSVCD__AT(to_world_at)
#define nsvcd__touch NSVCD__AT(touch)
#define nsvcd__track NSVCD__AT(track)
#define nsvcd__track_box NSVCD__AT(track_box)
#define nsvcd__track_of NSVCD__AT(track_of)
#define nsvcd__track_pose NSVCD__AT(track_pose)
#define nsvcd__track_pose_at NSVCD__AT(track_pose_at)
#define nsvcd__track_poses_at NSVCD__AT(track_poses_at)
#define nsvcd__transform_of NSVCD__AT(transform_of)
#define nsvcd__triangles_meet NSVCD__AT(triangles_meet)
#define nsvcd__try_lift NSVCD__AT(try_lift)
#define nsvcd__turn_at NSVCD__AT(turn_at)
#define nsvcd__turned NSVCD__AT(turned)
#define nsvcd__undoes NSVCD__AT(undoes)
#define nsvcd__undone NSVCD__AT(undone)
#define nsvcd__undone_by NSVCD__AT(undone_by)
#define nsvcd__unit_rotation NSVCD__AT(unit_rotation)
#define nsvcd__v NSVCD__AT(v)
#define nsvcd__v3 NSVCD__AT(v3)
#define nsvcd__v3_add NSVCD__AT(v3_add)
#define nsvcd__v3_centres NSVCD__AT(v3_centres)
#define nsvcd__v3_cross NSVCD__AT(v3_cross)
#define nsvcd__v3_dot NSVCD__AT(v3_dot)
#define nsvcd__v3_dot_add NSVCD__AT(v3_dot_add)
#define nsvcd__v3_fma NSVCD__AT(v3_fma)
#define nsvcd__v3_length NSVCD__AT(v3_length)
#define nsvcd__v3_load NSVCD__AT(v3_load)
#define nsvcd__v3_load_rows NSVCD__AT(v3_load_rows)
#define nsvcd__v3_max NSVCD__AT(v3_max)
#define nsvcd__v3_min NSVCD__AT(v3_min)
#define nsvcd__v3_negate NSVCD__AT(v3_negate)
#define nsvcd__v3_of NSVCD__AT(v3_of)
#define nsvcd__v3_rows NSVCD__AT(v3_rows)
#define nsvcd__v3_scale NSVCD__AT(v3_scale)
#define nsvcd__v3_set NSVCD__AT(v3_set)
#define nsvcd__v3_store NSVCD__AT(v3_store)
#define nsvcd__v3_store_rows NSVCD__AT(v3_store_rows)
#define nsvcd__v3_sub NSVCD__AT(v3_sub)
#define nsvcd__v3_transform NSVCD__AT(v3_transform)
#define nsvcd__v3_unit NSVCD__AT(v3_unit)
#define nsvcd__v_abs NSVCD__AT(v_abs)
#define nsvcd__v_across NSVCD__AT(v_across)
#define nsvcd__v_add_to NSVCD__AT(v_add_to)
#define nsvcd__v_approach NSVCD__AT(v_approach)
#define nsvcd__v_arc NSVCD__AT(v_arc)
#define nsvcd__v_arc_bound NSVCD__AT(v_arc_bound)
#define nsvcd__v_bits NSVCD__AT(v_bits)
#define nsvcd__v_clamp NSVCD__AT(v_clamp)
#define nsvcd__v_degree2 NSVCD__AT(v_degree2)
#define nsvcd__v_deviation NSVCD__AT(v_deviation)
#define nsvcd__v_disc NSVCD__AT(v_disc)
#define nsvcd__v_disc_along NSVCD__AT(v_disc_along)
#define nsvcd__v_disc_load NSVCD__AT(v_disc_load)
#define nsvcd__v_disc_range NSVCD__AT(v_disc_range)
#define nsvcd__v_disc_set NSVCD__AT(v_disc_set)
#define nsvcd__v_half_rotation NSVCD__AT(v_half_rotation)
#define nsvcd__v_keep_most NSVCD__AT(v_keep_most)
#define nsvcd__v_least NSVCD__AT(v_least)
#define nsvcd__v_load_int16 NSVCD__AT(v_load_int16)
#define nsvcd__v_max NSVCD__AT(v_max)
#define nsvcd__v_min NSVCD__AT(v_min)
#define nsvcd__v_negate NSVCD__AT(v_negate)
#define nsvcd__v_off NSVCD__AT(v_off)
#define nsvcd__v_part NSVCD__AT(v_part)
#define nsvcd__v_part_by_fixed NSVCD__AT(v_part_by_fixed)
#define nsvcd__v_part_by_moving NSVCD__AT(v_part_by_moving)
#define nsvcd__v_parted NSVCD__AT(v_parted)
#define nsvcd__v_pick NSVCD__AT(v_pick)
#define nsvcd__v_plus NSVCD__AT(v_plus)
#define nsvcd__v_pose NSVCD__AT(v_pose)
#define nsvcd__v_poses NSVCD__AT(v_poses)
#define nsvcd__v_poses_at NSVCD__AT(v_poses_at)
#define nsvcd__v_range NSVCD__AT(v_range)
#define nsvcd__v_scale NSVCD__AT(v_scale)
#define nsvcd__v_seen NSVCD__AT(v_seen)
#define nsvcd__v_shorter_turn_between NSVCD__AT(v_shorter_turn_between)
#define nsvcd__v_sign NSVCD__AT(v_sign)
#define nsvcd__v_signed_square NSVCD__AT(v_signed_square)
#define nsvcd__v_span NSVCD__AT(v_span)
#define nsvcd__v_span_load NSVCD__AT(v_span_load)
#define nsvcd__v_span_set NSVCD__AT(v_span_set)
#define nsvcd__v_turn_between NSVCD__AT(v_turn_between)
#define nsvcd__v_turn_off_axis NSVCD__AT(v_turn_off_axis)
#define nsvcd__v_unit_or NSVCD__AT(v_unit_or)
#define nsvcd__verdict NSVCD__AT(verdict)
#define nsvcd__vertices_apart NSVCD__AT(vertices_apart)
#define nsvcd__view NSVCD__AT(view)
#define nsvcd__views NSVCD__AT(views)
#define nsvcd__views_of NSVCD__AT(views_of)
#define nsvcd__vmat3 NSVCD__AT(vmat3)
#define nsvcd__vmat3_apply NSVCD__AT(vmat3_apply)
#define nsvcd__vmat3_apply_add NSVCD__AT(vmat3_apply_add)
#define nsvcd__vmat3_apply_transpose NSVCD__AT(vmat3_apply_transpose)
#define nsvcd__vmat3_fma NSVCD__AT(vmat3_fma)
#define nsvcd__vmat3_load NSVCD__AT(vmat3_load)
#define nsvcd__vmat3_mul NSVCD__AT(vmat3_mul)
#define nsvcd__vmat3_of NSVCD__AT(vmat3_of)
#define nsvcd__vmat3_rows NSVCD__AT(vmat3_rows)
#define nsvcd__vmat3_scale NSVCD__AT(vmat3_scale)
#define nsvcd__vmat3_set NSVCD__AT(vmat3_set)
#define nsvcd__vmat3_square NSVCD__AT(vmat3_square)
#define nsvcd__vmat3_store NSVCD__AT(vmat3_store)
#define nsvcd__vmat3_sub NSVCD__AT(vmat3_sub)
#define nsvcd__vmat3_transpose NSVCD__AT(vmat3_transpose)
#define nsvcd__vquat NSVCD__AT(vquat)
#define nsvcd__vquat_axis NSVCD__AT(vquat_axis)
#define nsvcd__vquat_dot NSVCD__AT(vquat_dot)
#define nsvcd__vquat_fma NSVCD__AT(vquat_fma)
#define nsvcd__vquat_inverse NSVCD__AT(vquat_inverse)
#define nsvcd__vquat_load NSVCD__AT(vquat_load)
#define nsvcd__vquat_mul NSVCD__AT(vquat_mul)
#define nsvcd__vquat_of NSVCD__AT(vquat_of)
#define nsvcd__vquat_set NSVCD__AT(vquat_set)
#define nsvcd__vquat_store NSVCD__AT(vquat_store)
#define nsvcd__vquat_unit NSVCD__AT(vquat_unit)
#define nsvcd__way_in NSVCD__AT(way_in)
#define nsvcd__way_of NSVCD__AT(way_of)
#define nsvcd__way_out NSVCD__AT(way_out)
#define nsvcd__weights_at NSVCD__AT(weights_at)
#define nsvcd__wigner NSVCD__AT(wigner)
#define nsvcd__winding_number NSVCD__AT(winding_number)
#define nsvcd__window_load NSVCD__AT(window_load)
#define nsvcd__world_pose NSVCD__AT(world_pose)
#define nsvcd__world_pose_between NSVCD__AT(world_pose_between)
#define nsvcd__world_pose_of NSVCD__AT(world_pose_of)
#define nsvcd__wrench_add NSVCD__AT(wrench_add)

// ---- the passes

// gcc leaves out at -O2 what makes these loops fast: at -O3 they take 0.75 to 0.85 of the time.
// Its clones of functions by constant arguments gain nothing: 30 KB and an eighth of its own time.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#pragma GCC optimize("O3", "no-ipa-cp-clone")
#endif
#pragma GCC target("avx2,fma,bmi,bmi2,lzcnt,popcnt")
#elif defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi,bmi2,lzcnt,popcnt"))), \
                             apply_to = function)
#endif
#undef NSVCD__SLICE
#define NSVCD__SLICE 8
#define NSVCD__ISA _avx2
#include "neuralsvcd.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC target("avx512f,avx512vl,avx512vnni")
#elif defined(__clang__)
#pragma clang attribute pop
#pragma clang attribute push( \
    __attribute__((target("avx512f,avx512vl,avx512vnni,fma,bmi,bmi2,lzcnt,popcnt"))), \
    apply_to = function)
#endif
#undef NSVCD__SLICE
#undef NSVCD__ISA
#undef NSVCD__BYTE_ROWS
#define NSVCD__SLICE 16
#define NSVCD__ISA _avx512
#define NSVCD__VNNI
#include "neuralsvcd.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC pop_options
#elif defined(__clang__)
#pragma clang attribute pop
#endif

// from here on a name is a name again, and vectors are those above
#undef NSVCD__SLICE
#undef NSVCD__ISA
#undef NSVCD__VNNI
#define NSVCD__SLICE 4
#undef NSVCD__AT
#undef NSVCD__NUMBER_AT
#define NSVCD__AT(name) nsvcd__##name
#define NSVCD__NUMBER_AT(name) NSVCD__##name

typedef enum nsvcd__isa { NSVCD__SSE2, NSVCD__AVX2, NSVCD__AVX512 } nsvcd__isa;

#if defined(_MSC_VER) && !defined(__clang__)
// What the processor and the system have, remembered: one word, which all threads that may write it
// at a time write alike.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  static volatile long known = -1;
  int first[4];
  int seventh[4];
  if (known >= 0) return (nsvcd__isa)known;
  __cpuid(first, 0);
  if (first[0] < 7) return NSVCD__SSE2;
  __cpuid(first, 1);
  __cpuidex(seventh, 7, 0);
  // the system, of vectors: OSXSAVE
  const int keeps_registers = first[2] >> 27 & 1;
  const unsigned long long kept = keeps_registers ? _xgetbv(0) : 0;
  const int fma = first[2] >> 12 & 1;
  const int bmi = seventh[1] >> 3 & seventh[1] >> 8 & 1;
  const int avx2 = (kept & 6) == 6 && fma && bmi && seventh[1] >> 5 & 1;
  const int vnni = seventh[1] >> 16 & (unsigned)seventh[1] >> 31 & seventh[2] >> 11 & 1;
  known = !avx2 ? NSVCD__SSE2 : (kept & 0xe0) == 0xe0 && vnni ? NSVCD__AVX512 : NSVCD__AVX2;
  return (nsvcd__isa)known;
}
#else
// What the processor and the system have. The compiler's own library asks them before main.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  const int fma = __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (!fma || !__builtin_cpu_supports("avx2")) return NSVCD__SSE2;
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni"))
    return NSVCD__AVX512;
  return NSVCD__AVX2;
}
#endif

#define NSVCD__BEST(name) \
  (nsvcd__isa_at_hand() == NSVCD__AVX512 ? nsvcd__##name##_avx512 \
   : nsvcd__isa_at_hand() == NSVCD__AVX2 ? nsvcd__##name##_avx2 \
                                         : nsvcd__##name)
#else
#define NSVCD__BEST(name) nsvcd__##name
#endif  // NSVCD__DISPATCH

// ---- what is asked, handed to the best of them

NSVCDDEF nsvcd_result nsvcd_self_test(void) {
  return NSVCD__BEST(self_test)();
}

NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question) {
  return NSVCD__BEST(sweep_size)(question);
}

NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer) {
  if (!question) return NSVCD_ERROR_ARGUMENT;
  return NSVCD__BEST(sweep_batch)(question, 1, workspace, workspace_size, answer);
}

NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers) {
  return NSVCD__BEST(sweep_batch)(questions, count, workspace, workspace_size, answers);
}

#ifndef NSVCD_NO_GRADIENT
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b) {
  return NSVCD__BEST(sweep_gradient)(question, workspace, workspace_size, answer, gradient_a,
                                     gradient_b);
}
#endif

// ===================================================== certificate: a proof that others can check

// -------------------------------------------------------------------------------- certificate/tree
// In: a mesh. Out: its components, and a tree of boxes over its triangles. The floor, top to
// bottom:
//
//   tree        boxes, and components
//   law         where a body is at a time, and how far points leave their chords
//   planes      one that parts two nodes over a stretch of time; its normal in a few bits
//   rays        what is inside of what at one time
//   certify     the walk that a certificate is
//
// What is built and reckoned here examples/verify builds and reckons again, by code of its own: the
// rules by which nodes are cut and opened, and the form of the bits, are the same in both.

#ifndef NSVCD_NO_CERTIFICATES
#define NSVCD__TREE_TRIANGLES 0x20000000
// nodes that wait, while a tree of so many triangles is walked through
#define NSVCD__TREE_STACK 32

// A run of triangles of a tree, with a box about them.
typedef struct nsvcd__node {
  // a row of boxes; of order
  uint32_t box, first, count;
} nsvcd__node;

struct nsvcd_tree {
  nsvcd_mesh mesh;
  // (2 triangles - 1), of a node, of its left tree, of its right tree
  nsvcd__box *boxes;
  // (triangles): the leaves, from left to right
  uint32_t *order;
  // (vertices): the lowest vertex of its component; NSVCD_NO_TRIANGLE: no triangle has it
  uint32_t *part;
  uint32_t digest;
};

static uint32_t nsvcd__digest(uint32_t digest, const void *words, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint32_t word;
    memcpy(&word, (const char *)words + 4 * i, 4);
    digest = (digest ^ word) * 0x9e3779b1u;
    digest ^= digest >> 15;
  }
  return digest;
}

static const float *nsvcd__tree_corner(const nsvcd_tree *tree, uint32_t triangle, uint32_t k) {
  const uint32_t vertex = tree->mesh.indices[3 * (size_t)triangle + k];
  return tree->mesh.positions + 3 * (size_t)vertex;
}

// Three times a triangle's middle.
static nsvcd__d3 nsvcd__tree_middle(const nsvcd_tree *tree, uint32_t triangle) {
  nsvcd__d3 sum = nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, 0));
  for (uint32_t k = 1; k < 3; k++)
    sum = nsvcd__d3_add(sum, nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, k)));
  return sum;
}

// Is a triangle before another one, whose key is known? Below 0: yes; above: it is after it.
static int nsvcd__tree_order(const nsvcd_tree *tree, uint32_t triangle, uint32_t other,
                             double key, size_t axis) {
  const double own = nsvcd__d3_axis(nsvcd__tree_middle(tree, triangle), axis);
  if (own < key || own > key) return own < key ? -1 : 1;
  return triangle < other ? -1 : triangle > other;
}

// The box of a node; its triangles so that those that are first along the axis
// along which their middles differ most, of
// equals those of lower number, are before the middle (Hoare 1961).
static void nsvcd__cut_node(nsvcd_tree *tree, const nsvcd__node *node) {
  uint32_t *order = tree->order + node->first;
  nsvcd__box box;
  box.low = box.high = nsvcd__f3_load(nsvcd__tree_corner(tree, order[0], 0));
  nsvcd__d3 least = nsvcd__tree_middle(tree, order[0]);
  nsvcd__d3 most = least;
  for (uint32_t i = 0; i < node->count; i++) {
    const nsvcd__d3 middle = nsvcd__tree_middle(tree, order[i]);
    least = nsvcd__d3_min(least, middle);
    most = nsvcd__d3_max(most, middle);
  }
  for (uint32_t i = 0; i < 3 * node->count; i++) {
    const nsvcd__f3 x = nsvcd__f3_load(nsvcd__tree_corner(tree, order[i / 3], i % 3));
    box.low = nsvcd__f3_min(box.low, x);
    box.high = nsvcd__f3_max(box.high, x);
  }
  tree->boxes[node->box] = box;
  const nsvcd__d3 sides = nsvcd__d3_sub(most, least);
  size_t axis = sides.y > sides.x;
  if (sides.z > nsvcd__d3_axis(sides, axis)) axis = 2;
  const ptrdiff_t half = (ptrdiff_t)(node->count / 2);
  ptrdiff_t from = 0;
  ptrdiff_t to = (ptrdiff_t)node->count - 1;
  while (from < to) {
    const uint32_t pivot = order[from + (to - from) / 2];
    const double key = nsvcd__d3_axis(nsvcd__tree_middle(tree, pivot), axis);
    ptrdiff_t i = from;
    ptrdiff_t j = to;
    while (i <= j) {
      while (nsvcd__tree_order(tree, order[i], pivot, key, axis) < 0) i++;
      while (nsvcd__tree_order(tree, order[j], pivot, key, axis) > 0) j--;
      if (i > j) break;
      const uint32_t swapped = order[i];
      order[i++] = order[j];
      order[j--] = swapped;
    }
    if (half > j) from = i;
    if (half < i) to = j;
  }
}

static void nsvcd__children(const nsvcd__node *node, nsvcd__node *left, nsvcd__node *right) {
  const nsvcd__node whole = *node;
  left->box = whole.box + 1;
  left->first = whole.first;
  left->count = whole.count / 2;
  right->box = whole.box + 2 * left->count;
  right->first = whole.first + left->count;
  right->count = whole.count - left->count;
}

static uint32_t nsvcd__part_root(uint32_t *part, uint32_t v) {
  while (part[v] != v) v = part[v] = part[part[v]];
  return v;
}

static void nsvcd__find_parts(nsvcd_tree *tree) {
  const uint32_t *indices = tree->mesh.indices;
  const size_t corners = 3 * tree->mesh.triangle_count;
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) tree->part[v] = NSVCD_NO_TRIANGLE;
  for (size_t i = 0; i < corners; i++) tree->part[indices[i]] = indices[i];
  for (size_t i = 0; i < corners; i++) {
    const uint32_t x = nsvcd__part_root(tree->part, indices[i]);
    const uint32_t y = nsvcd__part_root(tree->part, indices[i / 3 * 3]);
    tree->part[x > y ? x : y] = x > y ? y : x;
  }
  for (size_t i = 0; i < corners; i++)
    tree->part[indices[i]] = nsvcd__part_root(tree->part, indices[i]);
}

// Lays a tree out at base, or, where that is NULL, only counts. Returns the bytes that it takes.
static uint64_t nsvcd__tree_layout(const nsvcd_mesh *mesh, char *base, nsvcd_tree *tree) {
  uint64_t used = 0;
  const size_t triangles = mesh->triangle_count;
  (void)nsvcd__take(base, &used, 1, sizeof *tree);
  tree->boxes = (nsvcd__box *)nsvcd__take(base, &used, 2 * triangles - 1, sizeof(nsvcd__box));
  tree->order = (uint32_t *)nsvcd__take(base, &used, triangles, sizeof(uint32_t));
  tree->part = (uint32_t *)nsvcd__take(base, &used, mesh->vertex_count, sizeof(uint32_t));
  return used;
}

NSVCDDEF size_t nsvcd_tree_size(const nsvcd_mesh *mesh) {
  nsvcd_tree counted;
  if (nsvcd__mesh_check(mesh)) return 0;
  const uint64_t size = nsvcd__tree_layout(mesh, NULL, &counted);
  return size > SIZE_MAX ? 0 : (size_t)size;
}

NSVCDDEF nsvcd_result nsvcd_tree_build(const nsvcd_mesh *mesh, void *memory, size_t size,
                                       const nsvcd_tree **tree) {
  nsvcd__node stack[NSVCD__TREE_STACK];
  size_t height = 1;
  const nsvcd_result result = nsvcd__mesh_check(mesh);
  if (result) return result;
  if (!tree) return NSVCD_ERROR_ARGUMENT;
  const size_t needed = nsvcd_tree_size(mesh);
  if (mesh->triangle_count > NSVCD__TREE_TRIANGLES || !needed) return NSVCD_ERROR_TOO_LARGE;
  if (!memory || size < needed || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_tree *t = (nsvcd_tree *)memory;
  (void)nsvcd__tree_layout(mesh, (char *)memory, t);
  t->mesh = *mesh;
  t->digest =
      nsvcd__digest((uint32_t)mesh->vertex_count, mesh->positions, 3 * mesh->vertex_count);
  t->digest = nsvcd__digest(t->digest, mesh->indices, 3 * mesh->triangle_count);
  nsvcd__find_parts(t);
  for (size_t i = 0; i < mesh->triangle_count; i++) t->order[i] = (uint32_t)i;
  stack[0].box = stack[0].first = 0;
  stack[0].count = (uint32_t)mesh->triangle_count;
  while (height > 0) {
    const nsvcd__node node = stack[--height];
    nsvcd__cut_node(t, &node);
    if (node.count == 1) continue;
    nsvcd__children(&node, &stack[height], &stack[height + 1]);
    height += 2;
  }
  *tree = t;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_CERTIFICATES

// --------------------------------------------------------------------------------- certificate/law
// In: a mesh that moves. Out: where it is at a time, and by how much a point leaves the chord
// between its places at two times. In double, and with no more of the motion floor than what makes
// poses valid: a certificate is a second opinion.

#ifndef NSVCD_NO_CERTIFICATES
// Takes a corner x to turn scale x + at.
typedef struct nsvcd__posed {
  nsvcd__dmat3 turn;
  nsvcd__d3 at;
} nsvcd__posed;

// By how much a point at r metres from the body's origin leaves its chord, at most: base + per_metre
// r.
typedef struct nsvcd__off_chord {
  double base, per_metre;
} nsvcd__off_chord;

// A mesh that moves, t in [0,1]. A knot is a time at which the motion has a corner; between two of
// them points leave chords as said.
typedef struct nsvcd__rider {
  const nsvcd_tree *tree;
  double scale;
  nsvcd__posed (*place)(const void *motion, double t);
  // the next knot after a time before 1
  double (*next)(const void *motion, double t);
  nsvcd__off_chord (*off_chord)(const void *motion, double t0, double t1);
  const void *motion;
  uint32_t digest;  // of the scale and the motion
} nsvcd__rider;

// ---- of poses: nsvcd_mover

static double nsvcd__mover_knot(const nsvcd_mover *mover, size_t k) {
  return mover->times ? (double)mover->times[k] : (double)k / (double)(mover->count - 1);
}

// The last pose, but for the last one, that is not after a time; of a mover of two poses or more.
static size_t nsvcd__mover_pose(const nsvcd_mover *mover, double t) {
  size_t low = 0;
  size_t high = mover->count - 1;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    if (nsvcd__mover_knot(mover, middle) <= t)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// The arc from a pose to the next: rotations, on the shorter side; half the angle between them.
typedef struct nsvcd__turning {
  nsvcd__dquat from, to;
  double half_angle;
} nsvcd__turning;

static nsvcd__dquat nsvcd__pose_rotation(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dquat out = {(double)q[0], (double)q[1], (double)q[2], (double)q[3]};
  return out;
}

static nsvcd__turning nsvcd__turning_of(const nsvcd_pose *a, const nsvcd_pose *b) {
  nsvcd__turning out;
  const nsvcd__dquat from = nsvcd__pose_rotation(a);
  const nsvcd__dquat to = nsvcd__pose_rotation(b);
  const double side = nsvcd__dquat_dot(from, to) < 0 ? -1 : 1;
  out.from = nsvcd__dquat_unit(from);
  out.to = nsvcd__dquat_scale(nsvcd__dquat_unit(to), side);
  const nsvcd__dquat apart = nsvcd__dquat_fma(-1, out.from, out.to);
  const nsvcd__dquat together = nsvcd__dquat_fma(1, out.from, out.to);
  out.half_angle = 2 * atan2(sqrt(nsvcd__dquat_dot(apart, apart)),
                             sqrt(nsvcd__dquat_dot(together, together)));
  return out;
}

static nsvcd__posed nsvcd__mover_place(const void *motion, double t) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  nsvcd__posed out;
  if (mover->count == 1) {
    out.turn = nsvcd__dmat3_of(nsvcd__dquat_unit(nsvcd__pose_rotation(mover->poses)));
    out.at = nsvcd__d3_load(mover->poses->position);
    return out;
  }
  const size_t k = nsvcd__mover_pose(mover, t);
  const nsvcd_pose *a = &mover->poses[k];
  const double from = nsvcd__mover_knot(mover, k);
  const double u = (t - from) / (nsvcd__mover_knot(mover, k + 1) - from);
  const nsvcd__turning arc = nsvcd__turning_of(a, a + 1);
  double before = 1 - u;
  double after = u;
  // below, a line is as good
  if (arc.half_angle > 1e-7) {
    before = sin((1 - u) * arc.half_angle);
    after = sin(u * arc.half_angle);
  }
  const nsvcd__dquat q = nsvcd__dquat_fma(after, arc.to, nsvcd__dquat_scale(arc.from, before));
  out.turn = nsvcd__dmat3_of(nsvcd__dquat_unit(q));
  out.at = nsvcd__d3_mix(nsvcd__d3_load(a->position), nsvcd__d3_load(a[1].position), u);
  return out;
}

static double nsvcd__mover_next(const void *motion, double t) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  return mover->count > 1 ? nsvcd__mover_knot(mover, nsvcd__mover_pose(mover, t) + 1) : 1;
}

// A turn by h at a constant rate has a second derivative of h^2 r, and leaves its chord by an
// eighth of it.
static nsvcd__off_chord nsvcd__mover_off_chord(const void *motion, double t0, double t1) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  nsvcd__off_chord out = {0, 0};
  if (mover->count == 1) return out;
  const size_t k = nsvcd__mover_pose(mover, 0.5 * (t0 + t1));
  const nsvcd_pose *a = &mover->poses[k];
  const double whole = nsvcd__mover_knot(mover, k + 1) - nsvcd__mover_knot(mover, k);
  const double h = 2 * nsvcd__turning_of(a, a + 1).half_angle * (t1 - t0) / whole;
  out.per_metre = 0.1250001 * h * h;
  return out;
}

// Makes a rider of a mover, which is copied to *meant, with the defaults filled in.
static nsvcd_result nsvcd__ride(const nsvcd_mover *mover, const nsvcd_tree *tree,
                                nsvcd_mover *meant, nsvcd__rider *rider) {
  const float scale = nsvcd__scale_of(mover);
  *meant = *mover;
  if (!nsvcd__is_finite(mover->scale) || mover->scale < 0) return NSVCD_ERROR_SCALE;
  if (scale < NSVCD_MIN_SCALE || scale > NSVCD_MAX_SCALE) return NSVCD_ERROR_SCALE;
  const nsvcd_result result = nsvcd__poses_check(mover);
  if (result) return result;
  if (!mover->poses) {
    meant->poses = &nsvcd__at_origin;
    meant->count = 1;
  }
  if (meant->count == 1) meant->times = NULL;
  for (size_t k = 1; k < meant->count; k++) {
    const nsvcd__dquat from = nsvcd__pose_rotation(&meant->poses[k - 1]);
    const double dot = nsvcd__dquat_dot(from, nsvcd__pose_rotation(&meant->poses[k]));
    if (fabs(dot) < 1.001e-6) return NSVCD_ERROR_POSE;
  }
  rider->tree = tree;
  rider->scale = (double)scale;
  rider->place = nsvcd__mover_place;
  rider->next = nsvcd__mover_next;
  rider->off_chord = nsvcd__mover_off_chord;
  rider->motion = meant;
  rider->digest = nsvcd__digest((uint32_t)meant->count, meant->poses, 7 * meant->count);
  rider->digest = nsvcd__digest(rider->digest, &scale, 1);
  if (meant->times) rider->digest = nsvcd__digest(rider->digest, meant->times, meant->count);
  return NSVCD_OK;
}
#endif  // NSVCD_NO_CERTIFICATES

// ------------------------------------------------------------------------------ certificate/planes
// In: two nodes, and a stretch of time. Out: a plane that parts them all the while, by a normal
// that takes a few bits; or none.

#ifndef NSVCD_NO_CERTIFICATES
// What is asked for beyond what numbers say, of all lengths: the checker's, and a little more.
#define NSVCD__CERTIFIED_MARGIN 1.01e-10
#define NSVCD__NORMAL_STEPS 20    // of Gilbert's iteration
#define NSVCD__NORMAL_ENOUGH 0.8  // of the best distance that a normal may show
// of both lengths: nodes that come as near are opened, not parted
#define NSVCD__NORMAL_GIVE_UP 1e-3

// A time, where both bodies are then, and by how much points leave their chords to the next one.
typedef struct nsvcd__instant {
  double t;
  nsvcd__posed a, b;
  nsvcd__off_chord off_a, off_b;
} nsvcd__instant;

// A stretch of time: both ends, and all knots between.
typedef struct nsvcd__stretch {
  const nsvcd__rider *a, *b;
  double clearance;
  nsvcd__instant *instants;  // (capacity)
  size_t count, capacity;
  double t0, t1;
  // half way; its time is -1 before it is needed
  nsvcd__instant middle;
} nsvcd__stretch;

// A node of each tree.
typedef struct nsvcd__nodes {
  nsvcd__node a, b;
} nsvcd__nodes;

// A direction as it is written: two whole numbers.
typedef struct nsvcd__written_normal {
  nsvcd__d3 along;
  uint32_t x, y;
  int bits;  // of each number: 8 or 16
} nsvcd__written_normal;

static nsvcd__instant nsvcd__instant_at(const nsvcd__rider *a, const nsvcd__rider *b,
                                        double t) {
  nsvcd__instant at;
  memset(&at, 0, sizeof at);
  at.t = t;
  at.a = a->place(a->motion, t);
  at.b = b->place(b->motion, t);
  return at;
}

// There is room: the workspace was made for all knots.
static void nsvcd__stretch_to(nsvcd__stretch *s, double t0, double t1) {
  if (s->count > 0 && !(s->t0 < t0) && !(s->t0 > t0) && !(s->t1 < t1) && !(s->t1 > t1)) return;
  double t = t0;
  s->t0 = t0;
  s->t1 = t1;
  s->middle.t = -1;
  for (s->count = 0; s->count < s->capacity;) {
    nsvcd__instant *at = &s->instants[s->count++];
    *at = nsvcd__instant_at(s->a, s->b, t);
    if (!(t < t1)) return;
    t = nsvcd__min(s->a->next(s->a->motion, t), s->b->next(s->b->motion, t));
    t = nsvcd__min(t, t1);
    at->off_a = s->a->off_chord(s->a->motion, at->t, t);
    at->off_b = s->b->off_chord(s->b->motion, at->t, t);
  }
}

// The instant half way.
static const nsvcd__instant *nsvcd__stretch_middle(nsvcd__stretch *s) {
  if (s->middle.t < 0) s->middle = nsvcd__instant_at(s->a, s->b, 0.5 * (s->t0 + s->t1));
  return &s->middle;
}

// ---- nodes

// The corner of a node's box, or of its triangle, that is farthest along a direction of the world.
static nsvcd__d3 nsvcd__farthest(const nsvcd__rider *rider, const nsvcd__node *node,
                                 const nsvcd__posed *at, nsvcd__d3 along) {
  const nsvcd__d3 way = nsvcd__dmat3_apply_transpose(&at->turn, along);
  const nsvcd_tree *tree = rider->tree;
  if (node->count > 1) {
    const nsvcd__box *box = &tree->boxes[node->box];
    return nsvcd__d3_of((double)(way.x > 0 ? box->high.x : box->low.x),
                        (double)(way.y > 0 ? box->high.y : box->low.y),
                        (double)(way.z > 0 ? box->high.z : box->low.z));
  }
  const uint32_t triangle = tree->order[node->first];
  nsvcd__d3 best = nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, 0));
  for (uint32_t k = 1; k < 3; k++) {
    const nsvcd__d3 x = nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, k));
    if (nsvcd__d3_dot(x, way) > nsvcd__d3_dot(best, way)) best = x;
  }
  return best;
}

static nsvcd__d3 nsvcd__turned_by(const nsvcd__rider *rider, const nsvcd__posed *at,
                                  nsvcd__d3 x) {
  return nsvcd__d3_scale(nsvcd__dmat3_apply(&at->turn, x), rider->scale);
}

// Of all points of two nodes, one of each, the difference a - b that goes least along a direction.
static nsvcd__d3 nsvcd__least_apart(const nsvcd__stretch *s, const nsvcd__nodes *nodes,
                                    const nsvcd__instant *at, nsvcd__d3 along) {
  const nsvcd__d3 back = nsvcd__d3_scale(along, -1);
  const nsvcd__d3 a = nsvcd__farthest(s->a, &nodes->a, &at->a, back);
  const nsvcd__d3 b = nsvcd__farthest(s->b, &nodes->b, &at->b, along);
  const nsvcd__d3 turned =
      nsvcd__d3_sub(nsvcd__turned_by(s->a, &at->a, a), nsvcd__turned_by(s->b, &at->b, b));
  return nsvcd__d3_add(turned, nsvcd__d3_sub(at->a.at, at->b.at));
}

static double nsvcd__node_radius(const nsvcd__rider *rider, const nsvcd__node *node) {
  const nsvcd__box *box = &rider->tree->boxes[node->box];
  const nsvcd__f3 corner = nsvcd__f3_max(box->high, nsvcd__f3_scale(box->low, -1));
  return 1.000001 * rider->scale * nsvcd__d3_length(nsvcd__d3_widen(corner));
}

static double nsvcd__lengths_at(const nsvcd__posed *a, const nsvcd__posed *b) {
  return fabs(a->at.x) + fabs(a->at.y) + fabs(a->at.z) + fabs(b->at.x) + fabs(b->at.y) +
         fabs(b->at.z);
}

// Does a plane of this normal part two nodes, at all instants and between them?
static int nsvcd__plane_parts_nodes(const nsvcd__stretch *s, const nsvcd__nodes *nodes,
                                    nsvcd__d3 along) {
  const double length = nsvcd__d3_length(along);
  const double ra = nsvcd__node_radius(s->a, &nodes->a);
  const double rb = nsvcd__node_radius(s->b, &nodes->b);
  double last = HUGE_VAL;
  double leaves = 0;
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__instant *at = &s->instants[i];
    const double lengths = ra + rb + s->clearance + nsvcd__lengths_at(&at->a, &at->b);
    const double gap = nsvcd__d3_dot(along, nsvcd__least_apart(s, nodes, at, along));
    const double most = length * (s->clearance + leaves + NSVCD__CERTIFIED_MARGIN * lengths);
    if (!(gap > most && last > most)) return 0;
    last = gap;
    leaves = at->off_a.base + at->off_a.per_metre * ra;
    leaves += at->off_b.base + at->off_b.per_metre * rb;
  }
  return 1;
}

// ---- normals

static double nsvcd__signed(double magnitude, double sign) {
  return sign < 0 ? -magnitude : magnitude;
}

// A point of the octahedron |x| + |y| + |z| = half, seen from above, its lower half folded
// outwards.
static nsvcd__written_normal nsvcd__normal_of(nsvcd__d3 along, int bits) {
  const double half = (double)((1 << (bits - 1)) - 1);
  const double sum = fabs(along.x) + fabs(along.y) + fabs(along.z);
  const double x = along.x * (half / sum);
  const double y = along.y * (half / sum);
  const int below = along.z < 0;
  nsvcd__written_normal out;
  out.bits = bits;
  const double u = floor((below ? nsvcd__signed(half - fabs(y), x) : x) + 0.5);
  const double v = floor((below ? nsvcd__signed(half - fabs(x), y) : y) + 0.5);
  const double z = half - fabs(u) - fabs(v);
  out.x = (uint32_t)(u + half);
  out.y = (uint32_t)(v + half);
  out.along.x = z < 0 ? nsvcd__signed(half - fabs(v), u) : u;
  out.along.y = z < 0 ? nsvcd__signed(half - fabs(u), v) : v;
  out.along.z = z;
  return out;
}

// The best direction so far, and how far apart it shows two nodes half way; less than 0: not at
// all.
typedef struct nsvcd__best {
  nsvcd__d3 along;
  double gap;
} nsvcd__best;

// Tries a direction, and the one back.
static void nsvcd__try_along(const nsvcd__stretch *s, const nsvcd__nodes *nodes,
                             const nsvcd__instant *at, nsvcd__d3 along, nsvcd__best *best) {
  const double length = nsvcd__d3_length(along);
  for (int k = 0; k < 2 && length > 0; k++) {
    const nsvcd__d3 way = nsvcd__d3_scale(along, k ? -1 / length : 1 / length);
    const double gap = nsvcd__d3_dot(way, nsvcd__least_apart(s, nodes, at, way));
    if (gap <= best->gap) continue;
    best->along = way;
    best->gap = gap;
  }
}

// Gilbert's iteration towards the point of a - b that is nearest to the origin.
static nsvcd__best nsvcd__gilbert(const nsvcd__stretch *s, const nsvcd__nodes *nodes,
                                  const nsvcd__instant *at, nsvcd__d3 along) {
  nsvcd__best best = {along, -HUGE_VAL};
  nsvcd__d3 v = nsvcd__least_apart(s, nodes, at, along);
  const double enough = NSVCD__NORMAL_ENOUGH;
  const double size = nsvcd__d3_length(v);
  for (int step = 0; step < NSVCD__NORMAL_STEPS; step++) {
    const double length = nsvcd__d3_length(v);
    if (!(length > NSVCD__NORMAL_GIVE_UP * size)) break;
    const nsvcd__d3 w = nsvcd__least_apart(s, nodes, at, v);
    const double gap = nsvcd__d3_dot(v, w) / length;
    if (gap > best.gap) {
      best.along = v;
      best.gap = gap;
    }
    if (gap > enough * length) break;
    const nsvcd__d3 step_to = nsvcd__d3_sub(w, v);
    const double square = nsvcd__d3_dot(step_to, step_to);
    if (!(square > 0)) break;
    const double share = -nsvcd__d3_dot(v, step_to) / square;
    v = nsvcd__d3_fma(nsvcd__max(0, nsvcd__min(share, 1)), step_to, v);
  }
  return best;
}

// The edges of a leaf's triangle, in the world.
static void nsvcd__leaf_edges(const nsvcd__rider *rider, const nsvcd__node *node,
                              const nsvcd__posed *at, nsvcd__d3 *edges) {
  const uint32_t triangle = rider->tree->order[node->first];
  for (uint32_t k = 0; k < 3; k++) {
    const nsvcd__d3 from = nsvcd__d3_load(nsvcd__tree_corner(rider->tree, triangle, k));
    const nsvcd__d3 to =
        nsvcd__d3_load(nsvcd__tree_corner(rider->tree, triangle, (k + 1) % 3));
    edges[k] = nsvcd__turned_by(rider, at, nsvcd__d3_sub(to, from));
  }
}

// Looks for a plane that parts two nodes all the while.
static int nsvcd__find_normal(nsvcd__stretch *s, const nsvcd__nodes *nodes, nsvcd__d3 last,
                              nsvcd__written_normal *normal) {
  const nsvcd__instant *at = nsvcd__stretch_middle(s);
  nsvcd__best best = nsvcd__gilbert(s, nodes, at, last);
  if (nodes->a.count == 1 && nodes->b.count == 1) {
    nsvcd__d3 a[3], b[3];
    nsvcd__leaf_edges(s->a, &nodes->a, &at->a, a);
    nsvcd__leaf_edges(s->b, &nodes->b, &at->b, b);
    nsvcd__try_along(s, nodes, at, nsvcd__d3_cross(a[0], a[1]), &best);
    nsvcd__try_along(s, nodes, at, nsvcd__d3_cross(b[0], b[1]), &best);
    for (size_t i = 0; i < 9 && !(best.gap > 0); i++)
      nsvcd__try_along(s, nodes, at, nsvcd__d3_cross(a[i / 3], b[i % 3]), &best);
  }
  if (!(best.gap > s->clearance)) return 0;
  for (int bits = 8; bits <= 16; bits += 8) {
    *normal = nsvcd__normal_of(best.along, bits);
    if (nsvcd__plane_parts_nodes(s, nodes, normal->along)) return 1;
  }
  return 0;
}
#endif  // NSVCD_NO_CERTIFICATES

// -------------------------------------------------------------------------------- certificate/rays
// In: two bodies at one time. Out: what a ray from a corner of one crosses of the other; whether an
// edge passes through a triangle.

#ifndef NSVCD_NO_CERTIFICATES
#define NSVCD__UNCLEAR 2

// A vertex of one body in the frame of another, in units of that one's scale.
static nsvcd__d3 nsvcd__vertex_seen(const nsvcd__rider *of, const nsvcd__posed *of_at,
                                    const nsvcd__rider *by, const nsvcd__posed *by_at,
                                    uint32_t vertex) {
  const nsvcd__d3 x = nsvcd__d3_row(of->tree->mesh.positions, vertex);
  const nsvcd__d3 offset = nsvcd__d3_sub(of_at->at, by_at->at);
  const nsvcd__d3 world = nsvcd__d3_add(nsvcd__turned_by(of, of_at, x), offset);
  return nsvcd__d3_scale(nsvcd__dmat3_apply_transpose(&by_at->turn, world), 1 / by->scale);
}

// No length in that frame is more.
static double nsvcd__lengths_seen(const nsvcd__rider *of, const nsvcd__posed *of_at,
                                  const nsvcd__rider *by, const nsvcd__posed *by_at) {
  const nsvcd__node root = {0, 0, 2};
  const double radii = nsvcd__node_radius(of, &root) + nsvcd__node_radius(by, &root);
  return (radii + nsvcd__lengths_at(of_at, by_at)) / by->scale;
}

// Does a ray leave (1) or enter (-1) through a triangle, or miss it (0)? UNCLEAR: by too little.
static int nsvcd__ray_passes(const nsvcd_tree *tree, uint32_t triangle, nsvcd__d3 from,
                             nsvcd__d3 along, double lengths) {
  const double margin = NSVCD__CERTIFIED_MARGIN * lengths * lengths;
  const double area = margin * nsvcd__d3_length(along);
  nsvcd__d3 p[3];
  double sides[3];
  for (uint32_t k = 0; k < 3; k++)
    p[k] = nsvcd__d3_sub(nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, k)), from);
  const double ahead =
      nsvcd__max(nsvcd__d3_dot(p[0], along),
                 nsvcd__max(nsvcd__d3_dot(p[1], along), nsvcd__d3_dot(p[2], along)));
  if (ahead * lengths < -area) return 0;
  for (size_t k = 0; k < 3; k++)
    sides[k] = nsvcd__d3_dot(along, nsvcd__d3_cross(p[k], p[(k + 1) % 3]));
  const double least = nsvcd__min(sides[0], nsvcd__min(sides[1], sides[2]));
  const double most = nsvcd__max(sides[0], nsvcd__max(sides[1], sides[2]));
  if (least < -area && most > area) return 0;
  if (!(least > area || most < -area)) return NSVCD__UNCLEAR;
  const double volume = nsvcd__d3_dot(p[2], nsvcd__d3_cross(p[0], p[1]));
  if (!(fabs(volume) > margin * lengths)) return NSVCD__UNCLEAR;
  if ((volume > 0) != (most > 0)) return 0;
  return most > 0 ? 1 : -1;
}

// Sums what a ray crosses, by parts of the tree: sums (vertices). Returns 0 where it is not clear.
static int nsvcd__cast(const nsvcd_tree *tree, nsvcd__d3 from, nsvcd__d3 along, double lengths,
                       int32_t *sums) {
  memset(sums, 0, tree->mesh.vertex_count * sizeof *sums);
  for (size_t t = 0; t < tree->mesh.triangle_count; t++) {
    const int crossed = nsvcd__ray_passes(tree, (uint32_t)t, from, along, lengths);
    if (crossed == NSVCD__UNCLEAR) return 0;
    sums[tree->part[tree->mesh.indices[3 * t]]] += crossed;
  }
  return 1;
}

// How often there is an edge from one vertex to another.
static long nsvcd__edges_between(const nsvcd_tree *tree, uint32_t from, uint32_t to) {
  const nsvcd__f3 x = nsvcd__f3_load(tree->mesh.positions + 3 * (size_t)from);
  nsvcd__node stack[NSVCD__TREE_STACK] = {{0, 0, (uint32_t)tree->mesh.triangle_count}};
  size_t height = 1;
  long count = 0;
  while (height > 0) {
    const nsvcd__node node = stack[--height];
    const nsvcd__box *box = &tree->boxes[node.box];
    if (nsvcd__f3_exceeds(x, box->high) || nsvcd__f3_exceeds(box->low, x)) continue;
    if (node.count > 1) {
      nsvcd__children(&node, &stack[height], &stack[height + 1]);
      height += 2;
      continue;
    }
    const uint32_t *corner = tree->mesh.indices + 3 * (size_t)tree->order[node.first];
    for (size_t k = 0; k < 3; k++) count += corner[k] == from && corner[(k + 1) % 3] == to;
  }
  return count;
}

// Of what a ray crosses, what closed parts have: those of which each edge has as many reverses.
static int nsvcd__sum_of_closed(const nsvcd_tree *tree, int32_t *sums) {
  const uint32_t *indices = tree->mesh.indices;
  int sum = 0;
  for (size_t i = 0; i < 3 * tree->mesh.triangle_count; i++) {
    const uint32_t from = indices[i];
    const uint32_t to = indices[i % 3 == 2 ? i - 2 : i + 1];
    int32_t *crossed = &sums[tree->part[from]];
    if (*crossed == 0) continue;
    if (nsvcd__edges_between(tree, from, to) != nsvcd__edges_between(tree, to, from))
      *crossed = 0;
  }
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) sum += sums[v];
  return sum;
}
#endif  // NSVCD_NO_CERTIFICATES

// ----------------------------------------------------------------------------- certificate/certify
// In: a question and two trees. Out: a certificate, or none. The form of its bits:
//
//   all       version 1 (6 bits), kind (2), digests of both meshes (8 each), of motions, scales and
//             the clearance (16)
//   FREE      the walk, a code a visit, as examples/verify/nsvcd_verify.h has it: 0 open the node
//             whose box is longer; 11 parted by the last normal; 101 by another, which follows; 100
//             halve the time. Where the roots are nowhere parted: a ray for each part of a, then of
//             b, at t = 0: 1 along the last normal, or 0, and a normal
//   others    the time (32), then HIT: two triangles (32 each), whose edge (1), which (2); NEAR: two
//             triangles, a point on each (16, 16); INSIDE: whose corner (1), which (32), a normal
//   a normal  the last eight are remembered: k zeros and a 1 are the one k + 1 before the last; seven
//             zeros a new one: 0, two numbers of 8 bits; or 1, two of 16

#ifndef NSVCD_NO_CERTIFICATES
#define NSVCD__WALK_STACK 128  // nodes that wait
#define NSVCD__NO_EDGE 3u
#define NSVCD__SHORTEST_STRETCH 1e-12
#define NSVCD__REMEMBERED 8  // normals
#define NSVCD__RAYS 64       // that are tried for a part
// of the sum of both nodes' lengths: where they go farther the time is halved
#define NSVCD__FAR_TO_GO 0.35

enum { NSVCD__PROVES_FREE, NSVCD__PROVES_HIT, NSVCD__PROVES_NEAR, NSVCD__PROVES_INSIDE };

typedef struct nsvcd__visit {
  nsvcd__nodes nodes;
  double t0, t1;
} nsvcd__visit;

typedef struct nsvcd__certifier {
  nsvcd__rider a, b;
  nsvcd__stretch stretch;
  // the last ones, the last first
  nsvcd__d3 normals[NSVCD__REMEMBERED];
  uint8_t *bytes;
  size_t capacity, bits;
  uint32_t digest;  // of motions, scales and the clearance
  int apart;        // 1: the roots have been parted
  int32_t *sums;    // (vertices)
  nsvcd_certificate *made;
} nsvcd__certifier;

// ---- writing

static void nsvcd__write_bits(nsvcd__certifier *c, uint32_t value, int count) {
  while (count-- > 0) {
    const size_t at = c->bits / 8;
    if (at < c->capacity && c->bits % 8 == 0) c->bytes[at] = 0;
    if (at < c->capacity && (value >> count & 1))
      c->bytes[at] = (uint8_t)(c->bytes[at] | 0x80u >> c->bits % 8);
    c->bits++;
  }
}

// The normal that is remembered at place k > 0, or, where k is REMEMBERED, a new one. It becomes the
// last.
static void nsvcd__write_normal(nsvcd__certifier *c, size_t k,
                                const nsvcd__written_normal *normal) {
  const int known = k < NSVCD__REMEMBERED;
  const nsvcd__d3 along = known ? c->normals[k] : normal->along;
  nsvcd__write_bits(c, known, (int)(known ? k : k - 1));
  if (!known) {
    nsvcd__write_bits(c, normal->bits == 16, 1);
    nsvcd__write_bits(c, normal->x, normal->bits);
    nsvcd__write_bits(c, normal->y, normal->bits);
    k--;
  }
  for (; k > 0; k--) c->normals[k] = c->normals[k - 1];
  c->normals[0] = along;
}

static void nsvcd__write_head(nsvcd__certifier *c, uint32_t kind) {
  const uint32_t digests[3] = {c->a.tree->digest, c->b.tree->digest, c->digest};
  c->bits = 0;
  nsvcd__write_bits(c, 1, 6);
  nsvcd__write_bits(c, kind, 2);
  for (size_t k = 0; k < 3; k++) {
    const uint32_t half = digests[k] ^ digests[k] >> 16;
    nsvcd__write_bits(c, k < 2 ? (half ^ half >> 8) & 0xff : half & 0xffff, k < 2 ? 8 : 16);
  }
}

// A time as it is written: the nearest.
static uint32_t nsvcd__time_code(double t) {
  return (uint32_t)(nsvcd__max(0, nsvcd__min(t, 1)) * 4294967295.0 + 0.5);
}
static double nsvcd__coded_time(uint32_t code) {
  return (double)code / 4294967295.0;
}

// ---- what meets

// A triangle's corner k in another body's frame.
static nsvcd__d3 nsvcd__corner_seen(const nsvcd__rider *of, const nsvcd__posed *of_at,
                                    const nsvcd__rider *by, const nsvcd__posed *by_at,
                                    uint32_t triangle, uint32_t k) {
  const uint32_t vertex = of->tree->mesh.indices[3 * (size_t)triangle + k];
  return nsvcd__vertex_seen(of, of_at, by, by_at, vertex);
}

// Does an edge of a triangle of one pass through one of the other? Which.
static uint32_t nsvcd__piercing_edge(const nsvcd__rider *of, const nsvcd__posed *of_at,
                                     const nsvcd__rider *by, const nsvcd__posed *by_at,
                                     uint32_t own, uint32_t other) {
  const double lengths = nsvcd__lengths_seen(of, of_at, by, by_at);
  for (uint32_t k = 0; k < 3; k++) {
    const nsvcd__d3 from = nsvcd__corner_seen(of, of_at, by, by_at, own, k);
    const nsvcd__d3 to = nsvcd__corner_seen(of, of_at, by, by_at, own, (k + 1) % 3);
    const nsvcd__d3 along = nsvcd__d3_sub(to, from);
    const int there = nsvcd__ray_passes(by->tree, other, from, along, lengths);
    if (there != 1 && there != -1) continue;
    const nsvcd__d3 back = nsvcd__d3_scale(along, -1);
    if (nsvcd__ray_passes(by->tree, other, to, back, lengths) == -there) return k;
  }
  return NSVCD__NO_EDGE;
}

// The points of two triangles that are nearest to each other, by Gilbert's iteration with the
// corners' weights. Good to a hundredth of their distance, or in 200 steps as far as they lead.
static void nsvcd__nearest_weights(const nsvcd__d3 *a, const nsvcd__d3 *b, double *of_a,
                                   double *of_b) {
  for (size_t k = 0; k < 3; k++) of_a[k] = of_b[k] = k == 0;
  for (int step = 0; step < 200; step++) {
    nsvcd__d3 v = nsvcd__d3_of(0, 0, 0);
    size_t i = 0;
    size_t j = 0;
    for (size_t k = 0; k < 3; k++)
      v = nsvcd__d3_fma(of_a[k], a[k], nsvcd__d3_fma(-of_b[k], b[k], v));
    for (size_t k = 1; k < 3; k++) {
      if (nsvcd__d3_dot(v, a[k]) < nsvcd__d3_dot(v, a[i])) i = k;
      if (nsvcd__d3_dot(v, b[k]) > nsvcd__d3_dot(v, b[j])) j = k;
    }
    const nsvcd__d3 to = nsvcd__d3_sub(nsvcd__d3_sub(a[i], b[j]), v);
    const double square = nsvcd__d3_dot(to, to);
    const double down = -nsvcd__d3_dot(v, to);
    if (!(down > 0.01 * nsvcd__d3_dot(v, v)) || !(square > 0)) return;
    const double share = nsvcd__min(1, down / square);
    for (size_t k = 0; k < 3; k++) {
      of_a[k] += share * ((k == i) - of_a[k]);
      of_b[k] += share * ((k == j) - of_b[k]);
    }
  }
}

// A point of a triangle as it is written: shares of the way from the first corner to the second, and
// from there to the third. Its weights become those that are read.
static void nsvcd__point_code(double *weights, uint32_t *code) {
  const double beyond = weights[1] + weights[2];
  const double within = beyond > 0 ? weights[2] / beyond : 0;
  const double v = floor(65535 * nsvcd__min(1, beyond) + 0.5);
  const double w = floor(65535 * nsvcd__min(1, within) + 0.5);
  code[0] = (uint32_t)v;
  code[1] = (uint32_t)w;
  weights[0] = 1 - v / 65535;
  weights[1] = v / 65535 * (1 - w / 65535);
  weights[2] = v / 65535 * (w / 65535);
}

// Are two triangles nearer to each other than the clearance? At points that are written.
static int nsvcd__near_at(const nsvcd__certifier *c, const nsvcd__instant *at, uint32_t ta,
                          uint32_t tb, uint32_t *codes) {
  nsvcd__d3 a[3], b[3];
  double of_a[3], of_b[3];
  nsvcd__d3 apart = nsvcd__d3_of(0, 0, 0);
  const double lengths = nsvcd__lengths_seen(&c->a, &at->a, &c->b, &at->b);
  for (uint32_t k = 0; k < 3; k++) {
    a[k] = nsvcd__corner_seen(&c->a, &at->a, &c->b, &at->b, ta, k);
    b[k] = nsvcd__corner_seen(&c->b, &at->b, &c->b, &at->b, tb, k);
  }
  nsvcd__nearest_weights(a, b, of_a, of_b);
  nsvcd__point_code(of_a, codes);
  nsvcd__point_code(of_b, codes + 2);
  for (size_t k = 0; k < 3; k++)
    apart = nsvcd__d3_fma(of_a[k], a[k], nsvcd__d3_fma(-of_b[k], b[k], apart));
  const double distance = nsvcd__d3_length(apart) + NSVCD__CERTIFIED_MARGIN * lengths;
  return c->b.scale * distance < c->stretch.clearance;
}

// Do two triangles meet at a time, or come within the clearance? Then it writes the certificate.
static int nsvcd__meet_at(nsvcd__certifier *c, double when, uint32_t ta, uint32_t tb) {
  const uint32_t code = nsvcd__time_code(when);
  const double t = nsvcd__coded_time(code);
  const nsvcd__instant at = nsvcd__instant_at(&c->a, &c->b, t);
  uint32_t points[4];
  uint32_t whose = 0;
  uint32_t edge = nsvcd__piercing_edge(&c->a, &at.a, &c->b, &at.b, ta, tb);
  if (edge == NSVCD__NO_EDGE) {
    whose = 1;
    edge = nsvcd__piercing_edge(&c->b, &at.b, &c->a, &at.a, tb, ta);
  }
  const int pierced = edge != NSVCD__NO_EDGE;
  if (!pierced && !(c->stretch.clearance > 0 && nsvcd__near_at(c, &at, ta, tb, points)))
    return 0;
  nsvcd__write_head(c, pierced ? NSVCD__PROVES_HIT : NSVCD__PROVES_NEAR);
  nsvcd__write_bits(c, code, 32);
  nsvcd__write_bits(c, ta, 32);
  nsvcd__write_bits(c, tb, 32);
  if (pierced) {
    nsvcd__write_bits(c, whose, 1);
    nsvcd__write_bits(c, edge, 2);
  }
  for (size_t k = 0; k < 4 && !pierced; k++) nsvcd__write_bits(c, points[k], 16);
  c->made->verdict = NSVCD_HIT;
  c->made->time = t;
  return 1;
}

// Looks for a meeting where an answer has one, and a little later: at that time they only touch.
static int nsvcd__meet_as_told(nsvcd__certifier *c, const nsvcd_answer *answer) {
  const nsvcd_contact *told = answer->contact_count > 0 ? answer->contacts : &answer->nearest;
  const int named = told->triangle_a < c->a.tree->mesh.triangle_count &&
                    told->triangle_b < c->b.tree->mesh.triangle_count;
  if (answer->verdict != NSVCD_HIT || !named || !(told->time >= 0)) return 0;
  if (nsvcd__meet_at(c, (double)told->time, told->triangle_a, told->triangle_b)) return 1;
  for (double later = 1e-7; later < 1; later *= 2) {
    for (int k = 0; k < 2; k++) {
      const double when = (double)told->time + (k ? -later : later);
      if (nsvcd__meet_at(c, when, told->triangle_a, told->triangle_b)) return 1;
    }
  }
  return 0;
}

// ---- the walk

// The longest side of a node's box.
static double nsvcd__node_side(const nsvcd__rider *rider, const nsvcd__node *node) {
  const nsvcd__box *box = &rider->tree->boxes[node->box];
  const nsvcd__d3 sides = nsvcd__d3_sub(nsvcd__d3_widen(box->high), nsvcd__d3_widen(box->low));
  return rider->scale * nsvcd__max(nsvcd__max(sides.x, sides.y), sides.z);
}

static nsvcd__d3 nsvcd__node_middle(const nsvcd__rider *rider, const nsvcd__node *node,
                                    const nsvcd__posed *at) {
  const nsvcd__box *box = &rider->tree->boxes[node->box];
  const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_widen(box->low), nsvcd__d3_widen(box->high));
  return nsvcd__turned_by(rider, at, nsvcd__d3_scale(sum, 0.5));
}

// The way of one node's middle as the other's sees it, over the stretch, from instant to instant.
static double nsvcd__way_apart(const nsvcd__stretch *s, const nsvcd__nodes *nodes) {
  double way = 0;
  nsvcd__d3 last = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__instant *at = &s->instants[i];
    const nsvcd__d3 a = nsvcd__node_middle(s->a, &nodes->a, &at->a);
    const nsvcd__d3 b = nsvcd__node_middle(s->b, &nodes->b, &at->b);
    const nsvcd__d3 offset = nsvcd__d3_sub(at->a.at, at->b.at);
    const nsvcd__d3 now = nsvcd__d3_add(nsvcd__d3_sub(a, b), offset);
    if (i > 0) way += sqrt(nsvcd__d3_distance2(now, last));
    last = now;
  }
  return way;
}

// Puts two visits in place of one: of the children of the node whose box is longer, or of both
// halves of the time. The one that comes first is the later one on the stack.
static int nsvcd__divide_visit(nsvcd__certifier *c, nsvcd__visit *v) {
  nsvcd__nodes *nodes = &v->nodes;
  const double side_a = nsvcd__node_side(&c->a, &nodes->a);
  const double side_b = nsvcd__node_side(&c->b, &nodes->b);
  const int leaves = nodes->a.count == 1 && nodes->b.count == 1;
  const int halves =
      leaves || nsvcd__way_apart(&c->stretch, nodes) > NSVCD__FAR_TO_GO * (side_a + side_b);
  v[1] = *v;
  nsvcd__write_bits(c, halves ? 4 : 0, halves ? 3 : 1);
  if (halves) {
    v[1].t1 = v->t0 = 0.5 * (v->t0 + v->t1);
    return v->t1 - v[1].t0 >= NSVCD__SHORTEST_STRETCH;
  }
  if (nodes->b.count == 1 || (nodes->a.count > 1 && side_a >= side_b))
    nsvcd__children(&nodes->a, &v[1].nodes.a, &nodes->a);
  else
    nsvcd__children(&nodes->b, &v[1].nodes.b, &nodes->b);
  return 1;
}

// FREE, HIT, or UNDECIDED.
static nsvcd_verdict nsvcd__prove_walk(nsvcd__certifier *c, size_t visits) {
  nsvcd__visit stack[NSVCD__WALK_STACK];
  size_t height = 1;
  memset(stack, 0, sizeof *stack);
  stack->nodes.a.count = (uint32_t)c->a.tree->mesh.triangle_count;
  stack->nodes.b.count = (uint32_t)c->b.tree->mesh.triangle_count;
  stack->t1 = 1;
  nsvcd__write_head(c, NSVCD__PROVES_FREE);
  while (height > 0) {
    nsvcd__visit *v = &stack[height - 1];
    const nsvcd__nodes *nodes = &v->nodes;
    nsvcd__written_normal normal;
    if (c->made->visits++ >= visits) return NSVCD_UNDECIDED;
    nsvcd__stretch_to(&c->stretch, v->t0, v->t1);
    size_t k = 0;
    while (k < NSVCD__REMEMBERED &&
           !nsvcd__plane_parts_nodes(&c->stretch, nodes, c->normals[k]))
      k++;
    if (k < NSVCD__REMEMBERED ||
        nsvcd__find_normal(&c->stretch, nodes, c->normals[0], &normal)) {
      nsvcd__write_bits(c, k > 0 ? 5 : 3, k > 0 ? 3 : 2);
      if (k > 0) nsvcd__write_normal(c, k, &normal);
      if (nodes->a.box == 0 && nodes->b.box == 0) c->apart = 1;
      height--;
      continue;
    }
    if (nodes->a.count == 1 && nodes->b.count == 1) {
      const uint32_t ta = c->a.tree->order[nodes->a.first];
      const uint32_t tb = c->b.tree->order[nodes->b.first];
      if (nsvcd__meet_at(c, 0.5 * (v->t0 + v->t1), ta, tb)) return NSVCD_HIT;
    }
    if (height == NSVCD__WALK_STACK || !nsvcd__divide_visit(c, v)) return NSVCD_UNDECIDED;
    height++;
  }
  return NSVCD_FREE;
}

// ---- what is inside

// A direction to try: along the axes, then anywhere.
static nsvcd__written_normal nsvcd__ray_to_try(size_t k, uint64_t *random) {
  nsvcd__d3 along = nsvcd__d3_of(0, 0, 0);
  nsvcd__d3_set_axis(&along, k % 3, k < 3 ? 1 : -1);
  // a little off, so that it does not run along faces that are parallel to an axis
  along = nsvcd__d3_add(along, nsvcd__d3_of(0.05, 0.07, 0.11));
  if (k >= 6) {
    along.x = nsvcd__random(random) - 0.5;
    along.y = nsvcd__random(random) - 0.5;
    along.z = nsvcd__random(random) - 0.5;
  }
  return nsvcd__normal_of(along, 8);
}

// Rays from all parts of one body, at t = 0, that show them outside. FREE: all are written; HIT: one
// shows a corner inside, and the certificate is written; UNDECIDED: of a part none is clear.
static nsvcd_verdict nsvcd__cast_all(nsvcd__certifier *c, int whose) {
  const nsvcd__rider *of = whose ? &c->b : &c->a;
  const nsvcd__rider *by = whose ? &c->a : &c->b;
  const nsvcd__posed of_at = of->place(of->motion, 0);
  const nsvcd__posed by_at = by->place(by->motion, 0);
  const double lengths = nsvcd__lengths_seen(of, &of_at, by, &by_at);
  uint64_t random = 1;
  for (uint32_t v = 0; v < of->tree->mesh.vertex_count; v++) {
    if (of->tree->part[v] != v) continue;
    const nsvcd__d3 from = nsvcd__vertex_seen(of, &of_at, by, &by_at, v);
    int shown = 0;
    for (size_t k = 0; k <= NSVCD__RAYS && !shown; k++) {
      const int same = k == 0;
      const nsvcd__written_normal ray = nsvcd__ray_to_try(same ? 0 : k - 1, &random);
      const nsvcd__d3 along = same ? c->normals[0] : ray.along;
      if (!nsvcd__cast(by->tree, from, along, lengths, c->sums)) continue;
      shown = 1;
      for (size_t i = 0; i < by->tree->mesh.vertex_count; i++) shown &= c->sums[i] == 0;
      if (shown) {
        nsvcd__write_bits(c, (uint32_t)same, 1);
        if (!same) nsvcd__write_normal(c, NSVCD__REMEMBERED, &ray);
      } else if (!same && nsvcd__sum_of_closed(by->tree, c->sums) != 0) {
        nsvcd__write_head(c, NSVCD__PROVES_INSIDE);
        nsvcd__write_bits(c, nsvcd__time_code(0), 32);
        nsvcd__write_bits(c, (uint32_t)whose, 1);
        nsvcd__write_bits(c, v, 32);
        nsvcd__write_normal(c, NSVCD__REMEMBERED, &ray);
        c->made->inside = 1;
        return NSVCD_HIT;
      }
    }
    if (!shown) return NSVCD_UNDECIDED;
  }
  return NSVCD_FREE;
}

// ---- nsvcd_certify

// Lays the workspace out at base, or, where that is NULL, only counts.
static uint64_t nsvcd__certifier_layout(const nsvcd_question *question, const nsvcd_tree *a,
                                        const nsvcd_tree *b, char *base, nsvcd__certifier *c) {
  uint64_t used = 0;
  const size_t vertices = a->mesh.vertex_count > b->mesh.vertex_count ? a->mesh.vertex_count
                                                                      : b->mesh.vertex_count;
  c->stretch.capacity = nsvcd__pose_count(&question->a) + nsvcd__pose_count(&question->b) + 2;
  void *instants = nsvcd__take(base, &used, c->stretch.capacity, sizeof(nsvcd__instant));
  c->stretch.instants = (nsvcd__instant *)instants;
  c->sums = (int32_t *)nsvcd__take(base, &used, vertices, sizeof *c->sums);
  return used;
}

NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b) {
  nsvcd__certifier counted;
  if (!question || !a || !b || nsvcd__poses_check(&question->a) ||
      nsvcd__poses_check(&question->b))
    return 0;
  const uint64_t size = nsvcd__certifier_layout(question, a, b, NULL, &counted);
  return size > SIZE_MAX ? 0 : (size_t)size;
}

NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made) {
  const nsvcd_certify_options defaults = {NULL, 0};
  const nsvcd_certify_options *o = options ? options : &defaults;
  nsvcd_mover movers[2];
  nsvcd__certifier c;
  nsvcd_certificate out;
  if (!question || !a || !b || !made || (capacity > 0 && !bytes)) return NSVCD_ERROR_ARGUMENT;
  const float clearance = question->clearance;
  memset(&c, 0, sizeof c);
  memset(&out, 0, sizeof out);
  nsvcd_result result = nsvcd__ride(&question->a, a, &movers[0], &c.a);
  if (!result) result = nsvcd__ride(&question->b, b, &movers[1], &c.b);
  if (result) return result;
  if (question->skin < 0 || question->skin > 0) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__is_finite(clearance) || clearance < 0 || clearance > NSVCD_MAX_COORDINATE)
    return NSVCD_ERROR_TOLERANCE;
  const uint64_t needed = nsvcd__certifier_layout(question, a, b, (char *)workspace, &c);
  if (!workspace || !nsvcd__is_aligned(workspace) || workspace_size < needed)
    return NSVCD_ERROR_WORKSPACE;
  c.stretch.a = &c.a;
  c.stretch.b = &c.b;
  c.stretch.clearance = (double)clearance;
  c.bytes = bytes;
  c.capacity = capacity;
  c.digest = nsvcd__digest(c.a.digest + 31 * c.b.digest, &clearance, 1);
  c.made = &out;
  const int told = o->answer && nsvcd__meet_as_told(&c, o->answer);
  if (!told) {
    out.verdict = nsvcd__prove_walk(&c, o->visits ? o->visits : NSVCD_DEFAULT_VISITS);
    if (out.verdict == NSVCD_FREE && !c.apart) out.verdict = nsvcd__cast_all(&c, 0);
    if (out.verdict == NSVCD_FREE && !c.apart) out.verdict = nsvcd__cast_all(&c, 1);
  }
  out.size = out.verdict == NSVCD_UNDECIDED ? 0 : (c.bits + 7) / 8;
  *made = out;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_CERTIFICATES

// ============================================================ robot: is a motion of joints free?

// ------------------------------------------------------------------------------------- robot/chain
// In: a scene, and joint values. Out: a checker, and where links and parts are, in double. The
// floor, top to bottom:
//
//   chain       what moves what; where everything is
//   steps       what the joints do between two times
//   stray       how far points of a part can be from an axis; by how much a part leaves its sweep
//   path        is a motion of the joints free?
//   trees       configurations, and the nearest of them
//   postures    one configuration: what is near, a way out; which pairs can meet
//   ramps       from one state to another, within limits of speed and acceleration
//   smooth      a way in time, then smooth
//   route       a start and goals: two trees of proven edges, shortcuts
//
// It asks as any program does, by nsvcd_sweep.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// The schedule of a check.
// steps that are looked at together, at most, and how often a motion is halved where that is too
// few
#define NSVCD__MOST_STEPS 256
#define NSVCD__STRETCHES 24
// steps of what bends, at first
#define NSVCD__FIRST_STEPS 4
// radians or metres: where the way bends by less, steps go on across
#define NSVCD__CORNER 1e-3
// metres that a part may stray at first; each time a pair is asked again it may by this share of it
#define NSVCD__COARSE 2e-3
#define NSVCD__STRAY_SHARE 8
#define NSVCD__FINEST 1e-5f
// units that a look for a hit may take, before the last
#define NSVCD__GLANCE 200

// A joint, as the checker has it; and the link that it carries.
typedef struct nsvcd__link {
  // in the parent link: where the joint is, and how it is turned, unit
  nsvcd__d3 place;
  nsvcd__dquat turn;
  // unit, in the joint's frame
  nsvcd__d3 axis;
  // joints between the world and this link, itself included: bit i is joint i
  uint32_t path;
} nsvcd__link;

// Where a link is, in the world.
typedef struct nsvcd__frame {
  nsvcd__dquat turn;
  nsvcd__d3 place;
} nsvcd__frame;

// Joint values, and what follows from them.
typedef struct nsvcd__configuration {
  double joints[NSVCD_MAX_JOINTS];
  // of the links, the world first
  nsvcd__frame frames[NSVCD_MAX_JOINTS + 1];
  // of the joints, in the world: unit
  nsvcd__d3 axes[NSVCD_MAX_JOINTS];
} nsvcd__configuration;

// Sides along the world's axes.
typedef struct nsvcd__bounds {
  nsvcd__d3 low, high;
} nsvcd__bounds;

// A part, as the checker has it.
typedef struct nsvcd__member {
  // in its link
  nsvcd__frame frame;
  // of a sphere about its triangles, in its link; from its origin
  nsvcd__d3 centre;
  double radius, extent;
  // of a box about all of it, in its own axes, scaled; and half of its sides
  nsvcd__d3 middle, half;
  // about all samples, or where it rests
  nsvcd__bounds box;
  // of a part that moves: where its samples begin
  size_t row;
  // metres, at most: by how much it leaves the way between its samples, and what poses in float are
  // off
  double stray, rounding;
} nsvcd__member;

struct nsvcd_checker {
  const nsvcd_scene *scene;
  nsvcd__link links[NSVCD_MAX_JOINTS];
  nsvcd__member *members;  // (B)
  // (P): the pairs, as they are asked: what was hit last first
  uint32_t *order;
  // (P): those of a stretch that are not proven yet
  uint32_t *left;
  // (movers, NSVCD__MOST_STEPS + 1): samples, and boxes about the parts there
  nsvcd_pose *poses;
  nsvcd__bounds *boxes;
  // the times of the samples, and the most that a part strays in the step after each
  double times[NSVCD__MOST_STEPS + 1], strays[NSVCD__MOST_STEPS + 1];
  nsvcd__configuration at, next;
  void *query;
  size_t query_size;
};

static nsvcd__dquat nsvcd__dquat_mul(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__dquat back = {-a.x, -a.y, -a.z, a.w};
  return nsvcd__dquat_inverse_mul(back, b);
}

static nsvcd__d3 nsvcd__dquat_rotate(nsvcd__dquat q, nsvcd__d3 a) {
  const nsvcd__d3 axis = nsvcd__dquat_axis(q);
  const nsvcd__d3 twice = nsvcd__d3_scale(nsvcd__d3_cross(axis, a), 2);
  return nsvcd__d3_add(nsvcd__d3_fma(q.w, twice, a), nsvcd__d3_cross(axis, twice));
}

static nsvcd__frame nsvcd__frame_of(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dquat turn = {(double)q[0], (double)q[1], (double)q[2], (double)q[3]};
  const nsvcd__frame out = {nsvcd__dquat_unit(turn), nsvcd__d3_load(pose->position)};
  return out;
}

// What is `inner` in a frame, in the world.
static nsvcd__frame nsvcd__frame_in(const nsvcd__frame *frame, const nsvcd__frame *inner) {
  const nsvcd__d3 place = nsvcd__dquat_rotate(frame->turn, inner->place);
  const nsvcd__frame out = {nsvcd__dquat_mul(frame->turn, inner->turn),
                            nsvcd__d3_add(frame->place, place)};
  return out;
}

static nsvcd_pose nsvcd__pose_in(const nsvcd__frame *frame) {
  const nsvcd__dquat turn = nsvcd__dquat_unit(frame->turn);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__f3_round(frame->place), out.position);
  out.rotation[0] = (float)turn.x;
  out.rotation[1] = (float)turn.y;
  out.rotation[2] = (float)turn.z;
  out.rotation[3] = (float)turn.w;
  return out;
}

static int nsvcd__slides(const nsvcd_checker *c, size_t joint) {
  return c->scene->joints[joint].kind == NSVCD_JOINT_PRISMATIC;
}

// Places the links where c->joints says.
static void nsvcd__place_links(const nsvcd_checker *checker, nsvcd__configuration *c) {
  const nsvcd__frame world = {{0, 0, 0, 1}, {0, 0, 0}};
  c->frames[0] = world;
  for (size_t i = 0; i < checker->scene->joint_count; i++) {
    const nsvcd__link *link = &checker->links[i];
    const nsvcd__frame origin = {link->turn, link->place};
    nsvcd__frame frame =
        nsvcd__frame_in(&c->frames[checker->scene->joints[i].parent], &origin);
    c->axes[i] = nsvcd__dquat_rotate(frame.turn, link->axis);
    if (nsvcd__slides(checker, i)) {
      frame.place = nsvcd__d3_fma(c->joints[i], c->axes[i], frame.place);
    } else {
      const double half = 0.5 * c->joints[i];
      const nsvcd__d3 axis = nsvcd__d3_scale(link->axis, sin(half));
      const nsvcd__dquat turn = {axis.x, axis.y, axis.z, cos(half)};
      frame.turn = nsvcd__dquat_mul(frame.turn, turn);
    }
    c->frames[i + 1] = frame;
  }
}

static nsvcd__frame nsvcd__frame_of_part(const nsvcd_checker *checker,
                                         const nsvcd__configuration *c, size_t part) {
  return nsvcd__frame_in(&c->frames[checker->scene->parts[part].link],
                         &checker->members[part].frame);
}

NSVCDDEF void nsvcd_checker_place(const nsvcd_checker *checker, const double *joints,
                                  nsvcd_pose *poses) {
  nsvcd__configuration c;
  memcpy(c.joints, joints, checker->scene->joint_count * sizeof *joints);
  nsvcd__place_links(checker, &c);
  for (size_t n = 0; n < checker->scene->part_count; n++) {
    const nsvcd__frame frame = nsvcd__frame_of_part(checker, &c, n);
    poses[n] = nsvcd__pose_in(&frame);
  }
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------------- robot/steps
// In: a motion of the joints, and two times. Out: what the joints do between them.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// A step of a motion, from one time to another, h later; x is the share of it that has gone by.
typedef struct nsvcd__step {
  // joints at both ends
  double from[NSVCD_MAX_JOINTS], to[NSVCD_MAX_JOINTS];
  // |d|, d = to - from; max |q - from|
  double way[NSVCD_MAX_JOINTS], reach[NSVCD_MAX_JOINTS];
  // how much each joint bends: 8 |e| is no more, see robot/stray
  double bend[NSVCD_MAX_JOINTS];
} nsvcd__step;

// A motion as it is meant: of no pieces, a point and nothing else.
static nsvcd_joint_motion nsvcd__motion_meant(const nsvcd_joint_motion *motion) {
  const nsvcd_joint_motion still = {0, 0, motion->points, NULL};
  return motion->pieces ? *motion : still;
}

static double nsvcd__piece_start(const nsvcd_joint_motion *motion, size_t piece) {
  return motion->times ? motion->times[piece] : (double)piece;
}

static double nsvcd__piece_time(const nsvcd_joint_motion *motion, size_t piece) {
  return nsvcd__piece_start(motion, piece + 1) - nsvcd__piece_start(motion, piece);
}

// The piece that a time is in; of two, the later one.
static size_t nsvcd__piece_at(const nsvcd_joint_motion *motion, double time) {
  size_t low = 0;
  size_t high = motion->pieces;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    if (nsvcd__piece_start(motion, middle) <= time)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// The share of a piece that has gone by at a time.
static double nsvcd__share_at(const nsvcd_joint_motion *motion, size_t piece, double time) {
  const double start = nsvcd__piece_start(motion, piece);
  if (time >= nsvcd__piece_start(motion, piece + 1)) return 1;
  return time > start ? (time - start) / nsvcd__piece_time(motion, piece) : 0;
}

// Points of one joint in a piece.
static void nsvcd__joint_points(const nsvcd_joint_motion *motion, size_t piece, size_t joints,
                                size_t joint, double *p) {
  const double *first = motion->points + piece * motion->degree * joints + joint;
  for (size_t i = 0; i <= motion->degree; i++) p[i] = first[i * joints];
}

// The part of a piece from share s0 to s1: de Casteljau's algorithm, twice.
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

// The joints in a piece at a share of it, and, unless NULL, their speeds.
static void nsvcd__joints_at(const nsvcd_joint_motion *motion, size_t joints, size_t piece,
                             double share, double *at, double *speeds) {
  const size_t degree = motion->degree;
  for (size_t j = 0; j < joints; j++) {
    double p[NSVCD_MAX_DEGREE + 1];
    nsvcd__joint_points(motion, piece, joints, j, p);
    for (size_t level = degree; level > 0; level--) {
      if (level == 1 && speeds)
        speeds[j] = (double)degree * (p[1] - p[0]) / nsvcd__piece_time(motion, piece);
      // both ends exactly
      for (size_t i = 0; i < level; i++)
        p[i] = share < 1 ? p[i] + share * (p[i + 1] - p[i]) : p[i + 1];
    }
    at[j] = p[0];
  }
}

NSVCDDEF void nsvcd_motion_at(const nsvcd_joint_motion *motion, size_t joints, double time,
                              double *out) {
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  const size_t piece = nsvcd__piece_at(&m, time);
  nsvcd__joints_at(&m, joints, piece, nsvcd__share_at(&m, piece, time), out, NULL);
}

// By how much the speed of a joint jumps where a piece begins.
static double nsvcd__jump_at(const nsvcd_joint_motion *motion, size_t joints, size_t piece,
                             size_t joint) {
  const double *at = motion->points + piece * motion->degree * joints + joint;
  const double before = (at[0] - *(at - joints)) / nsvcd__piece_time(motion, piece - 1);
  const double after = (at[joints] - at[0]) / nsvcd__piece_time(motion, piece);
  return fabs((double)motion->degree * (after - before));
}

// What the joints do from time t0 to t1, through as many pieces as there are. Where the speed jumps
// by v, e has a corner: |e| is more by h v / 4 at most.
static void nsvcd__step_of(const nsvcd_joint_motion *motion, size_t joints, double t0,
                           double t1, nsvcd__step *step) {
  const size_t degree = motion->degree;
  const double twice = (double)(degree * (degree - 1));
  const size_t first = nsvcd__piece_at(motion, t0);
  size_t last = first;
  double v0[NSVCD_MAX_JOINTS], v1[NSVCD_MAX_JOINTS];
  double along = 0;
  double square = 0;
  const double h = t1 - t0;
  while (last + 1 < motion->pieces && nsvcd__piece_start(motion, last + 1) < t1) last++;
  const double end = nsvcd__share_at(motion, last, t1);
  nsvcd__joints_at(motion, joints, first, nsvcd__share_at(motion, first, t0), step->from, v0);
  nsvcd__joints_at(motion, joints, last, end, step->to, v1);
  for (size_t j = 0; j < joints; j++) {
    const double d = step->to[j] - step->from[j];
    step->way[j] = step->reach[j] = fabs(d);
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
      const double s0 = piece == first ? nsvcd__share_at(motion, piece, t0) : 0;
      const double s1 = piece == last ? end : 1;
      const double steps = h / nsvcd__piece_time(motion, piece);
      nsvcd__joint_points(motion, piece, joints, j, p);
      for (size_t i = 0; i + 2 <= degree; i++)
        second[i] = steps * steps * twice * (p[i] - 2 * p[i + 1] + p[i + 2]);
      if (degree >= 2) nsvcd__cut_curve(second, degree - 2, s0, s1);
      nsvcd__cut_curve(p, degree, s0, s1);
      for (size_t i = 0; i <= degree; i++)
        step->reach[j] = nsvcd__max(step->reach[j], fabs(p[i] - from));
      for (size_t i = 0; i + 2 <= degree; i++)
        step->bend[j] = nsvcd__max(step->bend[j], fabs(second[i] - g * d));
      if (piece > first) jumps += nsvcd__jump_at(motion, joints, piece, j);
    }
    step->bend[j] += 2 * h * jumps;
  }
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------------- robot/stray
// In: a part, and a step of the joints between two samples. Out: by how much it leaves, at most,
// the line and the slerp between them.
//
// THE BOUND. A step goes from joints q0 to q1 = q0 + d in a time h; x is the share of it that has
// gone by, and u = x - g x (1 - x) / 2 for a number |g| <= 2 of our choice: it goes from 0 to 1 as
// well, and never back. Each joint is q0 + u d + e, with e = 0 at both ends and e'' = h^2 q'' -
// g d, derivatives by x: |e| <= max |e''| / 8; where q' jumps by v, e' does by h v, and |e| may be
// more by h v / 4. What a point y of the part is, at most, off where
// q0 + u d has it:
//   sum over joints j of |e_j| r_j           r_j: no point is farther from the axis of j
// On the straight way q0 + u d the point is off its chord by max |y''| / 8, derivatives by u. With
// d^2 y / dq_j dq_k no more than r of the outer one of j and k, as long as both turn (an outer one
// that slides has 1 in place of r; an inner one that slides, 0),
//   |y''| <= sum_j |d_j| r_j (2 sum over inner k that turn of |d_k| + |d_j|)
// and what slides has no square. The sweep goes through the same places at both ends, by a line of
// the origin and a slerp by an angle w, and is off that chord by w^2 R / 8, R the point's distance
// from the origin. All together, for any u, and so at all times:
//   stray <= (sum_j max |e''_j| r_j + |y''| + w^2 R) / 8
// r_j is that of the sample q0, and what joints beyond j can add while they move.
// Source: this library.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// The angle of the turn from a to b, radians: the shorter one.
static double nsvcd__angle_between(nsvcd__dquat a, nsvcd__dquat b) {
  const double side = nsvcd__dquat_dot(a, b) < 0 ? -1 : 1;
  const nsvcd__dquat chord = nsvcd__dquat_fma(-side, b, a);
  return 4 * asin(nsvcd__min(0.5 * sqrt(nsvcd__dquat_dot(chord, chord)), 1));
}

// The bound of the banner, from levers r (F) on the path of joints. turn: w.
static double nsvcd__stray_by(const nsvcd_checker *c, const nsvcd__step *step, uint32_t path,
                              const double *levers, double turn, double extent) {
  double bend = 0;
  double second = 0;
  double inner = 0;
  for (; path; path &= path - 1) {
    const size_t j = nsvcd__low_bit(path);
    const double own = nsvcd__slides(c, j) ? 0 : step->way[j];
    bend += step->bend[j] * levers[j];
    second += step->way[j] * levers[j] * (2 * inner + own);
    inner += own;
  }
  return (bend + second + turn * turn * extent) / 8;
}

// r of the banner: how far points of a part can be from the axes of the joints on its path, during
// a step that begins in a configuration; 1 of what slides.
static void nsvcd__levers_of(const nsvcd_checker *c, size_t part, const nsvcd__step *step,
                             const nsvcd__configuration *from, double *levers) {
  const nsvcd__member *m = &c->members[part];
  const size_t link = c->scene->parts[part].link;
  const uint32_t path = c->links[link - 1].path;
  const nsvcd__frame *frame = &from->frames[link];
  const nsvcd__d3 centre =
      nsvcd__d3_add(nsvcd__dquat_rotate(frame->turn, m->centre), frame->place);
  double moved = 0;  // by joints beyond this one
  for (size_t j = link; j-- > 0;) {
    if (!(path >> j & 1)) continue;
    levers[j] = 1;
    if (!nsvcd__slides(c, j)) {
      const nsvcd__d3 off = nsvcd__d3_sub(centre, from->frames[j + 1].place);
      levers[j] = nsvcd__d3_length(nsvcd__d3_cross(from->axes[j], off)) + m->radius + moved;
    }
    moved += step->reach[j] * levers[j];
  }
}

// What a part strays at most in a step from one configuration to another.
static double nsvcd__stray_of(const nsvcd_checker *c, size_t part, const nsvcd__step *step,
                              const nsvcd__configuration *from,
                              const nsvcd__configuration *to) {
  const size_t link = c->scene->parts[part].link;
  double levers[NSVCD_MAX_JOINTS];
  const double turn = nsvcd__angle_between(from->frames[link].turn, to->frames[link].turn);
  nsvcd__levers_of(c, part, step, from, levers);
  return nsvcd__stray_by(c, step, c->links[link - 1].path, levers, turn,
                         c->members[part].extent);
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// -------------------------------------------------------------------------------------- robot/path
// In: a checker and a motion of its joints. Out: is it free, as the joints make it, at all times?

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// ---- a checker

// Is x a number, and no larger? By the bits, which are in the order of what is not negative.
static int nsvcd__is_number(double x, double most) {
  uint64_t bits, limit;
  memcpy(&bits, &x, sizeof bits);
  memcpy(&limit, &most, sizeof limit);
  return (bits & ~(uint64_t)0 >> 1) <= limit;
}

static nsvcd_result nsvcd__joint_check(const nsvcd_joint *joint, size_t i) {
  double axis = 0;
  if (joint->parent > i || (unsigned)joint->kind > NSVCD_JOINT_PRISMATIC)
    return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 3; k++) {
    if (!nsvcd__is_finite(joint->axis[k])) return NSVCD_ERROR_NUMBER;
    axis = nsvcd__max(axis, fabs((double)joint->axis[k]));
  }
  if (!(axis > 1e-15) || axis > 1e15) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__poses_are_valid(&joint->origin, 1)) return NSVCD_ERROR_POSE;
  const double most = (double)NSVCD_MAX_COORDINATE;
  if (!nsvcd__is_number(joint->speed, most) || !nsvcd__is_number(joint->acceleration, most))
    return NSVCD_ERROR_NUMBER;
  if (joint->speed < 0 || joint->acceleration < 0) return NSVCD_ERROR_ARGUMENT;
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return NSVCD_OK;
  if (!nsvcd__is_number(joint->low, most) || !nsvcd__is_number(joint->high, most))
    return NSVCD_ERROR_NUMBER;
  return joint->low <= joint->high ? NSVCD_OK : NSVCD_ERROR_ARGUMENT;
}

static nsvcd_result nsvcd__part_check(const nsvcd_scene *scene, const nsvcd_part *part) {
  if (!part->body || part->link > scene->joint_count) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__triangles_of(part->body)) return NSVCD_ERROR_BODY;
  const float scale = part->scale;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE;
  if (!(fits || (scale <= 0 && scale >= 0))) return NSVCD_ERROR_SCALE;
  return nsvcd__poses_are_valid(&part->pose, 1) ? NSVCD_OK : NSVCD_ERROR_POSE;
}

static nsvcd_result nsvcd__scene_check(const nsvcd_scene *scene) {
  nsvcd_result result = NSVCD_OK;
  if (!scene || scene->joint_count < 1 || scene->joint_count > NSVCD_MAX_JOINTS)
    return NSVCD_ERROR_ARGUMENT;
  if (!scene->joints || scene->part_count > NSVCD_MAX_PARTS) return NSVCD_ERROR_ARGUMENT;
  if ((scene->part_count > 0 && !scene->parts) || (scene->pair_count > 0 && !scene->pairs))
    return NSVCD_ERROR_ARGUMENT;
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__joint_check(&scene->joints[i], i);
  for (size_t n = 0; n < scene->part_count && !result; n++)
    result = nsvcd__part_check(scene, &scene->parts[n]);
  for (size_t k = 0; k < scene->pair_count && !result; k++) {
    const nsvcd_body_pair *pair = &scene->pairs[k];
    if (pair->a >= scene->part_count || pair->b >= scene->part_count)
      return NSVCD_ERROR_ARGUMENT;
    if (scene->parts[pair->a].link == scene->parts[pair->b].link) return NSVCD_ERROR_ARGUMENT;
  }
  return result;
}

// A box about a part that is in this frame.
static nsvcd__bounds nsvcd__box_of(const nsvcd__member *m, const nsvcd__frame *frame) {
  const nsvcd__dmat3 axes = nsvcd__dmat3_of(frame->turn);
  const nsvcd__d3 *rows[3] = {&axes.x, &axes.y, &axes.z};
  nsvcd__d3 half = {0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 row = {fabs(rows[k]->x), fabs(rows[k]->y), fabs(rows[k]->z)};
    nsvcd__d3_set_axis(&half, k, nsvcd__d3_dot(row, m->half));
  }
  const nsvcd__d3 middle = nsvcd__d3_add(nsvcd__dmat3_apply(&axes, m->middle), frame->place);
  const nsvcd__bounds out = {nsvcd__d3_sub(middle, half), nsvcd__d3_add(middle, half)};
  return out;
}

static nsvcd__bounds nsvcd__box_over(const nsvcd__bounds *a, const nsvcd__bounds *b) {
  const nsvcd__bounds out = {nsvcd__d3_min(a->low, b->low), nsvcd__d3_max(a->high, b->high)};
  return out;
}

// Are two boxes apart by more than `room` along an axis?
static int nsvcd__boxes_apart(const nsvcd__bounds *a, const nsvcd__bounds *b, double room) {
  return a->low.x - b->high.x > room || b->low.x - a->high.x > room ||
         a->low.y - b->high.y > room || b->low.y - a->high.y > room ||
         a->low.z - b->high.z > room || b->low.z - a->high.z > room;
}

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
  c->members = (nsvcd__member *)nsvcd__take(base, &used, parts, sizeof(nsvcd__member));
  c->order = (uint32_t *)nsvcd__take(base, &used, pairs, sizeof(uint32_t));
  c->left = (uint32_t *)nsvcd__take(base, &used, pairs, sizeof(uint32_t));
  c->poses = (nsvcd_pose *)nsvcd__take(base, &used, movers * samples, sizeof(nsvcd_pose));
  c->boxes =
      (nsvcd__bounds *)nsvcd__take(base, &used, movers * samples, sizeof(nsvcd__bounds));
  c->query_size = nsvcd_sweep_workspace_size(NULL);
  c->query = nsvcd__take(base, &used, 1, c->query_size);
  *checker = (nsvcd_checker *)at;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene) {
  nsvcd_checker *unused;
  return nsvcd__scene_check(scene) ? 0 : nsvcd__checker_layout(scene, NULL, &unused);
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
  c->scene = scene;
  for (size_t i = 0; i < scene->joint_count; i++) {
    const nsvcd_joint *joint = &scene->joints[i];
    const nsvcd__frame origin = nsvcd__frame_of(&joint->origin);
    nsvcd__link *link = &c->links[i];
    link->place = origin.place;
    link->turn = origin.turn;
    link->axis = nsvcd__d3_unit(nsvcd__d3_load(joint->axis), nsvcd__d3_of(0, 0, 1));
    link->path = (uint32_t)1 << i | (joint->parent ? c->links[joint->parent - 1].path : 0);
  }
  size_t row = 0;
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd_part *part = &scene->parts[n];
    const double scale = part->scale > 0 ? (double)part->scale : 1;
    nsvcd__member *m = &c->members[n];
    m->frame = nsvcd__frame_of(&part->pose);
    const nsvcd__d3 centre = nsvcd__d3_scale(nsvcd__d3_load(part->body->centre), scale);
    const nsvcd__frame sphere = {{0, 0, 0, 1}, centre};
    m->centre = nsvcd__frame_in(&m->frame, &sphere).place;
    // spheres are reckoned in float
    m->radius = 1.000001 * scale * (double)part->body->radius;
    m->extent = 1.000001 * scale * (double)part->body->extent;
    const nsvcd__facets facets = nsvcd__facets_of(nsvcd__triangles_of(part->body));
    const nsvcd__d3 low = nsvcd__d3_load(facets.box);
    const nsvcd__d3 high = nsvcd__d3_load(facets.box + 3);
    const nsvcd__d3 all = {1, 1, 1};
    m->middle = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5 * scale);
    // what is round goes beyond
    m->half = nsvcd__d3_fma(scale * (double)facets.round, all,
                            nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5 * scale));
    m->box = nsvcd__box_of(m, &m->frame);
    m->stray = 0;
    m->rounding = 0;
    m->row = part->link ? NSVCD__MOST_STEPS + 1 : 0;
    m->row *= row;
    row += part->link > 0;
  }
  for (size_t k = 0; k < scene->pair_count; k++) c->order[k] = (uint32_t)k;
  *checker = c;
  return NSVCD_OK;
}

// ---- samples

// Places the parts that move, at a configuration, as sample k.
static void nsvcd__sample_put(nsvcd_checker *c, const nsvcd__configuration *at, size_t k) {
  const nsvcd_scene *scene = c->scene;
  for (size_t n = 0; n < scene->part_count; n++) {
    nsvcd__member *m = &c->members[n];
    if (!scene->parts[n].link) continue;
    const nsvcd__frame frame = nsvcd__frame_of_part(c, at, n);
    const nsvcd__bounds box = nsvcd__box_of(m, &frame);
    c->poses[m->row + k] = nsvcd__pose_in(&frame);
    c->boxes[m->row + k] = box;
    m->box = k ? nsvcd__box_over(&m->box, &box) : box;
    // places and quaternions as floats are off by no more
    const double rounding = 1.1e-7 * nsvcd__d3_length(frame.place) + 1.3e-7 * m->extent;
    m->rounding = k ? nsvcd__max(m->rounding, rounding) : rounding;
  }
}

// Fills in, for each part that moves, its samples at c->times, one more than steps, and by how much
// it strays between them.
static void nsvcd__sample(nsvcd_checker *c, const nsvcd_joint_motion *motion, size_t steps) {
  const nsvcd_scene *scene = c->scene;
  const size_t bytes = scene->joint_count * sizeof(double);
  nsvcd__step step;
  nsvcd__configuration *from = &c->at;
  nsvcd__configuration *to = &c->next;
  for (size_t n = 0; n < scene->part_count; n++) c->members[n].stray = 0;
  nsvcd_motion_at(motion, scene->joint_count, c->times[0], from->joints);
  nsvcd__place_links(c, from);
  nsvcd__sample_put(c, from, 0);
  for (size_t k = 0; k < steps; k++) {
    nsvcd__step_of(motion, scene->joint_count, c->times[k], c->times[k + 1], &step);
    memcpy(to->joints, step.to, bytes);
    nsvcd__place_links(c, to);
    nsvcd__sample_put(c, to, k + 1);
    c->strays[k] = 0;
    for (size_t n = 0; n < scene->part_count; n++) {
      nsvcd__member *m = &c->members[n];
      if (!scene->parts[n].link) continue;
      const double stray = nsvcd__stray_of(c, n, &step, from, to) * (1 + 1e-9);
      c->strays[k] = nsvcd__max(c->strays[k], stray);
      m->stray = nsvcd__max(m->stray, stray);
    }
    nsvcd__configuration *other = from;
    from = to;
    to = other;
  }
}

// Cuts steps so that no part strays by more than is allowed, as far as can be foreseen: strays go
// by the square of a step. Returns how many there are then, more than NSVCD__MOST_STEPS if there
// were too many: then nothing is done.
static size_t nsvcd__refine_steps(nsvcd_checker *c, size_t steps, double allowed) {
  size_t total = 0;
  for (size_t k = 0; k < steps; k++) {
    const double pieces = ceil(sqrt(c->strays[k] / allowed));
    if (!(pieces <= NSVCD__MOST_STEPS)) return NSVCD__MOST_STEPS + 1;
    total += pieces > 1 ? (size_t)pieces : 1;
  }
  if (total > NSVCD__MOST_STEPS) return total;
  size_t at = total;
  c->times[total] = c->times[steps];
  for (size_t k = steps; k-- > 0;) {
    const double pieces = nsvcd__max(ceil(sqrt(c->strays[k] / allowed)), 1);
    const double from = c->times[k];
    const double way = c->times[at] - from;
    for (size_t i = (size_t)pieces; i-- > 0;) c->times[--at] = from + way * (double)i / pieces;
  }
  return total;
}

// ---- pairs

static nsvcd__bounds nsvcd__bounds_at(const nsvcd_checker *c, size_t part, size_t k) {
  const nsvcd__member *m = &c->members[part];
  return c->scene->parts[part].link ? c->boxes[m->row + k] : m->box;
}
// A box about a part in a step: it goes no farther from it than it strays.
static nsvcd__bounds nsvcd__bounds_in(const nsvcd_checker *c, size_t part, size_t step) {
  const nsvcd__bounds from = nsvcd__bounds_at(c, part, step);
  const nsvcd__bounds to = nsvcd__bounds_at(c, part, step + 1);
  return nsvcd__box_over(&from, &to);
}

// Steps, one after another, of a pair that may come near in the first and in the last of them. As
// many as 0 with no configuration but one.
typedef struct nsvcd__spell {
  size_t first, steps;
} nsvcd__spell;

// Where does a pair come as near as `room`, by its boxes? Returns 0 if nowhere.
static int nsvcd__spell_of(const nsvcd_checker *c, const nsvcd_body_pair *pair, size_t steps,
                           double room, nsvcd__spell *spell) {
  size_t last = 0;
  if (nsvcd__boxes_apart(&c->members[pair->a].box, &c->members[pair->b].box, room)) return 0;
  spell->first = steps;
  for (size_t k = 0; k < steps; k++) {
    const nsvcd__bounds a = nsvcd__bounds_in(c, pair->a, k);
    const nsvcd__bounds b = nsvcd__bounds_in(c, pair->b, k);
    if (nsvcd__boxes_apart(&a, &b, room)) continue;
    if (spell->first == steps) spell->first = k;
    last = k + 1;
  }
  spell->steps = last - (steps ? spell->first : 0);
  return steps == 0 || last > 0;
}

// By how much a part is off the way that its samples say, at most.
static double nsvcd__off(const nsvcd_checker *c, size_t part) {
  return c->members[part].stray + 2 * c->members[part].rounding;
}

// Of two parts in so many poses each; what rests has one.
static nsvcd_question nsvcd__question_of(const nsvcd_checker *c, const nsvcd_body_pair *pair,
                                         const nsvcd_pose *const *poses, size_t count,
                                         size_t work) {
  const size_t parts[2] = {pair->a, pair->b};
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_part *part = &c->scene->parts[parts[n]];
    nsvcd_mover *mover = n ? &question.b : &question.a;
    mover->body = part->body;
    mover->scale = part->scale;
    mover->poses = part->link ? poses[n] : &part->pose;
    mover->count = part->link ? count : 1;
  }
  question.method = NSVCD_METHOD_PROOF;
  question.work = work;
  return question;
}

// Asks whether two parts come as near as the clearance.
static nsvcd_result nsvcd__ask_poses(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                     const nsvcd_pose *const *poses, size_t count,
                                     float clearance, const nsvcd_check_options *options,
                                     nsvcd_answer *found, nsvcd_check_answer *answer) {
  nsvcd_question question = nsvcd__question_of(c, pair, poses, count, options->work);
  question.clearance = clearance;
  answer->sweeps++;
  return nsvcd_sweep(&question, c->query, c->query_size, found);
}

// Asks about a pair, in the poses of so many steps, whether it comes as near as the clearance and
// `strays` more. spell: what was asked about; the times of *found are of it.
static nsvcd_result nsvcd__ask_pair(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                    size_t steps, double strays,
                                    const nsvcd_check_options *options, nsvcd__spell *spell,
                                    nsvcd_answer *found, nsvcd_check_answer *answer) {
  const double clearance = (double)options->clearance + strays;
  const double off = nsvcd__off(c, pair->a) + nsvcd__off(c, pair->b);
  const double room = (double)options->clearance + off;
  if (!nsvcd__spell_of(c, pair, steps, room * (1 + 1e-9), spell)) {
    found->verdict = NSVCD_FREE;
    return NSVCD_OK;
  }
  const nsvcd_pose *const poses[2] = {c->poses + c->members[pair->a].row + spell->first,
                                      c->poses + c->members[pair->b].row + spell->first};
  return nsvcd__ask_poses(c, pair, poses, spell->steps + 1,
                          clearance > 0 ? nsvcd__round_outward(clearance) : 0, options, found,
                          answer);
}

// Is a pair hit at joints of its motion? Then the answer says so.
static nsvcd_result nsvcd__ask_at(nsvcd_checker *c, size_t pair, const double *joints,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_answer found;
  nsvcd_pose at[2];
  const nsvcd_pose *const poses[2] = {&at[0], &at[1]};
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  const size_t parts[2] = {both->a, both->b};
  memcpy(c->at.joints, joints, c->scene->joint_count * sizeof *joints);
  nsvcd__place_links(c, &c->at);
  answer->placed++;
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__frame frame = nsvcd__frame_of_part(c, &c->at, parts[n]);
    at[n] = nsvcd__pose_in(&frame);
  }
  const nsvcd_result result =
      nsvcd__ask_poses(c, both, poses, 1, options->clearance, options, &found, answer);
  if (result || found.verdict != NSVCD_HIT) return result;
  answer->verdict = NSVCD_HIT;
  answer->contact = found.nearest;
  return NSVCD_OK;
}

// Puts a pair first in the order.
static void nsvcd__put_first(nsvcd_checker *c, size_t pair) {
  size_t at = 0;
  while (c->order[at] != pair) at++;
  for (; at > 0; at--) c->order[at] = c->order[at - 1];
  c->order[0] = (uint32_t)pair;
}

// Is a pair that is not proven hit in one configuration? Asked about where it is as near as its
// proof reached, then about where the samples' own way hits. found: what the proof said.
static nsvcd_result nsvcd__seek_hit(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                                    size_t pair, size_t steps, nsvcd__spell *spell,
                                    nsvcd_answer *found, const nsvcd_check_options *options,
                                    nsvcd_check_answer *answer) {
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  double joints[NSVCD_MAX_JOINTS];
  nsvcd_result result = NSVCD_OK;
  answer->pair = pair;
  answer->why = found->why;
  for (int look = 0; look < 2 && !result && found->verdict != NSVCD_FREE; look++) {
    if (steps > 0) {
      // times of a sweep go by samples
      const double at =
          (double)spell->steps * nsvcd__max(0, nsvcd__min(1, (double)found->nearest.time));
      const size_t within = (size_t)at < spell->steps ? (size_t)at : spell->steps - 1;
      const size_t k = spell->first + within;
      const double share = at - (double)within;
      const double time = c->times[k] + share * (c->times[k + 1] - c->times[k]);
      answer->piece = nsvcd__piece_at(motion, time);
      answer->share = nsvcd__share_at(motion, answer->piece, time);
    }
    nsvcd__joints_at(motion, c->scene->joint_count, answer->piece, answer->share, joints,
                     NULL);
    result = nsvcd__ask_at(c, pair, joints, options, answer);
    if (answer->verdict == NSVCD_HIT) return result;
    if (look == 0 && !result)
      result = nsvcd__ask_pair(c, both, steps, 0, options, spell, found, answer);
  }
  return result;
}

// A stretch of a motion from time t0 to t1 in so many steps at first, or, with none, one
// configuration. What takes too many steps is halved, so often at most.
static nsvcd_result nsvcd__check_stretch(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                                         double t0, double t1, size_t steps, int halvings,
                                         const nsvcd_check_options *options,
                                         nsvcd_check_answer *answer) {
  size_t left = c->scene->pair_count;
  double allowed = NSVCD__COARSE;
  nsvcd_answer found;
  nsvcd__spell spell;
  nsvcd_check_options glance = *options;
  if (!glance.work || glance.work > NSVCD__GLANCE) glance.work = NSVCD__GLANCE;
  memcpy(c->left, c->order, left * sizeof *c->left);
  answer->piece = nsvcd__piece_at(motion, t0);
  answer->share = nsvcd__share_at(motion, answer->piece, t0);
  for (size_t k = 0; k <= steps; k++)
    c->times[k] = k < steps ? t0 + (t1 - t0) * (double)k / (double)steps : t1;
  nsvcd__sample(c, motion, steps);
  answer->placed += steps + 1;
  while (left > 0) {
    const size_t finer = nsvcd__refine_steps(c, steps, allowed);
    if (finer > NSVCD__MOST_STEPS) {
      const double middle = 0.5 * (t0 + t1);
      answer->why = NSVCD_WHY_WORK;
      if (halvings == 0 || !(middle > t0 && middle < t1)) return NSVCD_OK;
      const nsvcd_result result =
          nsvcd__check_stretch(c, motion, t0, middle, steps, halvings - 1, options, answer);
      if (result || answer->verdict != NSVCD_FREE) return result;
      answer->verdict = NSVCD_UNDECIDED;
      return nsvcd__check_stretch(c, motion, middle, t1, steps, halvings - 1, options, answer);
    }
    if (finer > steps) {
      steps = finer;
      nsvcd__sample(c, motion, steps);
      answer->placed += steps + 1;
    }
    size_t kept = 0;
    for (size_t n = 0; n < left; n++) {
      const size_t pair = c->left[n];
      const nsvcd_body_pair *both = &c->scene->pairs[pair];
      const double strays = nsvcd__off(c, both->a) + nsvcd__off(c, both->b);
      nsvcd_result result =
          nsvcd__ask_pair(c, both, steps, strays, options, &spell, &found, answer);
      if (!result && found.verdict == NSVCD_FREE) continue;
      // a glance, but for the last time
      const int is_last = steps == 0 || allowed <= (double)options->finest;
      if (!result)
        result = nsvcd__seek_hit(c, motion, pair, steps, &spell, &found,
                                 is_last ? options : &glance, answer);
      if (result) return result;
      if (answer->verdict == NSVCD_HIT) {
        nsvcd__put_first(c, pair);
        return NSVCD_OK;
      }
      c->left[kept++] = (uint32_t)pair;
    }
    left = kept;
    if (left == 0) break;
    if (steps == 0 || allowed <= (double)options->finest) return NSVCD_OK;
    allowed = nsvcd__max(allowed / NSVCD__STRAY_SHARE, (double)options->finest);
  }
  answer->pair = NSVCD_NONE;
  answer->verdict = NSVCD_FREE;
  return NSVCD_OK;
}

// Does the motion turn sharply where a piece begins? There a sample belongs.
static int nsvcd__is_corner(const nsvcd_joint_motion *motion, size_t joints, size_t piece) {
  const double before = nsvcd__piece_time(motion, piece - 1);
  const double after = nsvcd__piece_time(motion, piece);
  double jumps = 0;
  for (size_t j = 0; j < joints; j++) jumps += nsvcd__jump_at(motion, joints, piece, j);
  return !(jumps * nsvcd__min(before, after) <= NSVCD__CORNER);
}

// What a joint may be out of its limits by rounding.
static double nsvcd__limit_off(const nsvcd_joint *joint) {
  return 1e-9 * (1 + fabs(joint->low) + fabs(joint->high));
}

// Does a joint leave its limits in a piece? Halved until it is within at all its points, or out at
// an end.
static int nsvcd__leaves(const double *points, size_t degree, double low, double high,
                         int depth) {
  double first[NSVCD_MAX_DEGREE + 1], second[NSVCD_MAX_DEGREE + 1];
  int within = 1;
  for (size_t i = 0; i <= degree; i++) within &= points[i] >= low && points[i] <= high;
  if (within) return 0;
  if (depth == 0 || !(points[0] >= low && points[0] <= high)) return 1;
  if (!(points[degree] >= low && points[degree] <= high)) return 1;
  memcpy(first, points, (degree + 1) * sizeof *points);
  memcpy(second, points, (degree + 1) * sizeof *points);
  nsvcd__cut_curve(first, degree, 0, 0.5);
  nsvcd__cut_curve(second, degree, 0.5, 1);
  return nsvcd__leaves(first, degree, low, high, depth - 1) ||
         nsvcd__leaves(second, degree, low, high, depth - 1);
}

// A joint that leaves its limits in a piece by more than rounding, or NSVCD_NONE.
static size_t nsvcd__joint_outside(const nsvcd_scene *scene, const nsvcd_joint_motion *motion,
                                   size_t piece) {
  double own[NSVCD_MAX_DEGREE + 1];
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    nsvcd__joint_points(motion, piece, scene->joint_count, j, own);
    const double off = nsvcd__limit_off(joint);
    if (nsvcd__leaves(own, motion->degree, joint->low - off, joint->high + off, 30)) return j;
  }
  return NSVCD_NONE;
}

NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_check_answer found;
  nsvcd_check_options o;
  if (!checker || !motion || !answer || !motion->points) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  const size_t joints = scene->joint_count;
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  if (m.pieces && (m.degree < 1 || m.degree > NSVCD_MAX_DEGREE)) return NSVCD_ERROR_ARGUMENT;
  if (m.pieces > SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints)
    return NSVCD_ERROR_ARGUMENT;
  const double most = (double)NSVCD_MAX_COORDINATE;
  for (size_t k = 0; k < (m.pieces * m.degree + 1) * joints; k++) {
    if (!nsvcd__is_number(m.points[k], most)) return NSVCD_ERROR_NUMBER;
  }
  for (size_t p = 0; p <= m.pieces && m.times; p++) {
    if (!nsvcd__is_number(m.times[p], most)) return NSVCD_ERROR_NUMBER;
    if (p > 0 && !(m.times[p] > m.times[p - 1])) return NSVCD_ERROR_ARGUMENT;
  }
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_finite(o.clearance) || !nsvcd__is_finite(o.finest) || o.clearance < 0 ||
      o.finest < 0)
    return NSVCD_ERROR_TOLERANCE;
  o.finest = o.finest > 0 ? o.finest : NSVCD__FINEST;
  memset(&found, 0, sizeof found);
  found.joint = found.pair = found.piece = NSVCD_NONE;
  for (size_t p = 0; p < m.pieces + !m.pieces && found.joint == NSVCD_NONE; p++)
    found.joint = nsvcd__joint_outside(scene, &m, p);
  found.verdict = NSVCD_UNDECIDED;
  nsvcd_result result = NSVCD_OK;
  if (m.pieces == 0) result = nsvcd__check_stretch(checker, &m, 0, 0, 0, 0, &o, &found);
  // from corner to corner
  for (size_t p = 0, next; p < m.pieces && !result; p = next) {
    next = p + 1;
    while (next < m.pieces && !nsvcd__is_corner(&m, joints, next)) next++;
    const size_t steps = next - p == 1 && m.degree == 1 ? 1 : NSVCD__FIRST_STEPS;
    found.verdict = NSVCD_UNDECIDED;
    result = nsvcd__check_stretch(checker, &m, nsvcd__piece_start(&m, p),
                                  nsvcd__piece_start(&m, next), steps, NSVCD__STRETCHES, &o,
                                  &found);
    if (found.verdict != NSVCD_FREE) break;
  }
  if (result) return result;
  if (found.verdict == NSVCD_FREE) {
    found.piece = NSVCD_NONE;
    found.share = 0;
    found.why = NSVCD_WHY_NOTHING;
  }
  *answer = found;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------------- robot/trees
// In: configurations. Out: a tree of them, and the one that is nearest to another.
//
// Distances are Euclidean, radians and metres alike. A k-d tree that grows: a leaf of more points
// than it may hold is cut half way along the joint in which they are widest apart.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
#define NSVCD__LEAF 8

typedef struct nsvcd__cell {
  // where it is cut, or of a leaf: nothing
  double at;
  // by which joint; NSVCD_MAX_JOINTS: a leaf
  uint32_t joint;
  // the two halves, one after another; of a leaf: a node and, by `next`, the others, and how many
  uint32_t first, count;
} nsvcd__cell;

typedef struct nsvcd__tree {
  size_t joints, count, cell_count;
  double *points;      // (nodes, F)
  uint32_t *parents;   // (nodes): of a root, itself
  uint32_t *next;      // (nodes): in a leaf
  nsvcd__cell *cells;  // (2 nodes)
} nsvcd__tree;

static double nsvcd__way2(const double *a, const double *b, size_t joints) {
  double sum = 0;
  for (size_t j = 0; j < joints; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

// Cuts a leaf, unless all its points are the same.
static void nsvcd__leaf_cut(nsvcd__tree *t, size_t index) {
  nsvcd__cell *cell = &t->cells[index];
  size_t widest = 0;
  double width = 0;
  double middle = 0;
  for (size_t j = 0; j < t->joints; j++) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      low = nsvcd__min(low, t->points[node * t->joints + j]);
      high = nsvcd__max(high, t->points[node * t->joints + j]);
    }
    if (!(high - low > width)) continue;
    widest = j;
    width = high - low;
    middle = 0.5 * (low + high);
  }
  if (!(width > 0)) return;
  nsvcd__cell *halves = &t->cells[t->cell_count];
  t->cell_count += 2;
  for (size_t k = 0; k < 2; k++) {
    halves[k].joint = NSVCD_MAX_JOINTS;
    halves[k].count = 0;
  }
  uint32_t node = cell->first;
  for (uint32_t n = 0; n < cell->count; n++) {
    const uint32_t following = t->next[node];
    nsvcd__cell *half = &halves[t->points[node * t->joints + widest] > middle];
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
static size_t nsvcd__tree_add(nsvcd__tree *t, const double *at, size_t parent) {
  const size_t node = t->count++;
  size_t index = 0;
  memcpy(&t->points[node * t->joints], at, t->joints * sizeof *at);
  t->parents[node] = (uint32_t)parent;
  if (t->cell_count == 0) {
    t->cell_count = 1;
    t->cells[0].joint = NSVCD_MAX_JOINTS;
    t->cells[0].count = 0;
  }
  while (t->cells[index].joint < NSVCD_MAX_JOINTS)
    index = t->cells[index].first + (at[t->cells[index].joint] > t->cells[index].at);
  t->next[node] = t->cells[index].first;
  t->cells[index].first = (uint32_t)node;
  if (++t->cells[index].count > NSVCD__LEAF) nsvcd__leaf_cut(t, index);
  return node;
}

// Looks in a cell, which is `off` from the point, joint by joint, for what is nearer than *best.
static void nsvcd__nearest_in(const nsvcd__tree *t, size_t index, const double *at,
                              double *off, double off2, size_t *nearest, double *best) {
  const nsvcd__cell *cell = &t->cells[index];
  if (!(off2 < *best)) return;
  if (cell->joint == NSVCD_MAX_JOINTS) {
    uint32_t node = cell->first;
    for (uint32_t n = 0; n < cell->count; n++, node = t->next[node]) {
      const double way = nsvcd__way2(&t->points[node * t->joints], at, t->joints);
      if (!(way < *best)) continue;
      *best = way;
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
static size_t nsvcd__tree_nearest(const nsvcd__tree *t, const double *at) {
  double off[NSVCD_MAX_JOINTS] = {0};
  double best = HUGE_VAL;
  size_t nearest = 0;
  nsvcd__nearest_in(t, 0, at, off, 0, &nearest, &best);
  return nearest;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ---------------------------------------------------------------------------------- robot/postures
// In: a robot in one configuration. Out: pairs that are near, and how that changes with the joints;
// a configuration near by that is free; which pairs can meet.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
#define NSVCD__GAP_WITHIN 0.05f
#define NSVCD__GAP_TO 2e-5f
#define NSVCD__GAP_DEEPEST 0.02f
// of `deepest`: the first skin that is tried; and how often a lift is halved
#define NSVCD__LEAST_SKIN 0.015625f
#define NSVCD__DEPTH_HALVINGS 12
// of the depth: what is looked at to see which faces part last; and the least share of a lift that
// parts them, of which a slope is told
#define NSVCD__DEPTH_BEYOND 1.01
#define NSVCD__LEAST_RATE 0.1
#define NSVCD__FARTHEST_ESCAPE 0.5
// metres that an escape leaves beside the clearance, so that a route can begin there
#define NSVCD__ESCAPE_ROOM 5e-4f
// spheres about the joints that random configurations are drawn on, and how many on each; how much
// nearer than the best the next is drawn; halvings of the way back
#define NSVCD__ESCAPE_RINGS 8
#define NSVCD__ESCAPE_DRAWS 64
#define NSVCD__ESCAPE_NEARER 0.9
#define NSVCD__ESCAPE_HALVINGS 10
#define NSVCD__PAIR_SAMPLES 64

static nsvcd_result nsvcd__check_joints(const nsvcd_checker *checker, const double *joints) {
  if (!checker || !joints) return NSVCD_ERROR_ARGUMENT;
  for (size_t j = 0; j < checker->scene->joint_count; j++) {
    if (!nsvcd__is_number(joints[j], (double)NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  }
  return NSVCD_OK;
}

// Places all parts where the joints say, as the first of their samples.
static void nsvcd__stand(nsvcd_checker *c, const double *joints) {
  memcpy(c->at.joints, joints, c->scene->joint_count * sizeof *joints);
  nsvcd__place_links(c, &c->at);
  nsvcd__sample_put(c, &c->at, 0);
}

// Of two parts where they stand.
static nsvcd_question nsvcd__standing_question(const nsvcd_checker *c,
                                               const nsvcd_body_pair *pair, size_t work) {
  const nsvcd_pose *const poses[2] = {c->poses + c->members[pair->a].row,
                                      c->poses + c->members[pair->b].row};
  return nsvcd__question_of(c, pair, poses, 1, work);
}

// ---- gaps

// How the point of a part that is at `point` now moves along a normal, by each joint: added to the
// slope, times `sign`.
static void nsvcd__slope_add(const nsvcd_checker *c, size_t part, nsvcd__d3 point,
                             nsvcd__d3 normal, double sign, double *slope) {
  const uint32_t link = c->scene->parts[part].link;
  for (uint32_t path = link ? c->links[link - 1].path : 0; path; path &= path - 1) {
    const size_t j = nsvcd__low_bit(path);
    const nsvcd__d3 lever = nsvcd__d3_sub(point, c->at.frames[j + 1].place);
    const nsvcd__d3 speed =
        nsvcd__slides(c, j) ? c->at.axes[j] : nsvcd__d3_cross(c->at.axes[j], lever);
    slope[j] += sign * nsvcd__d3_dot(normal, speed);
  }
}

// Asks a question with a lifted by so much.
static nsvcd_result nsvcd__ask_lifted(nsvcd_checker *c, const nsvcd_question *question,
                                      nsvcd__d3 lift, nsvcd_answer *found) {
  nsvcd_pose lifted = *question->a.poses;
  nsvcd_question asked = *question;
  const nsvcd__d3 place = nsvcd__d3_add(nsvcd__d3_load(lifted.position), lift);
  asked.a.poses = &lifted;
  nsvcd__f3_store(nsvcd__f3_round(place), lifted.position);
  return nsvcd_sweep(&asked, c->query, c->query_size, found);
}

// A lift of a off b that parts them, by the least of some skins, each four times the one before,
// that is enough. 0: none up to `deepest` is.
static nsvcd_result nsvcd__parting_lift(nsvcd_checker *c, nsvcd_question question,
                                        float deepest, nsvcd__d3 *lift) {
  nsvcd_answer found;
  for (float share = NSVCD__LEAST_SKIN; share <= 1; share *= 4) {
    question.skin = share * deepest;
    const nsvcd_result result = nsvcd_sweep(&question, c->query, c->query_size, &found);
    if (result) return result;
    *lift = nsvcd__d3_load(found.lift);
    if (found.verdict == NSVCD_FREE) return NSVCD_OK;
  }
  *lift = nsvcd__d3_of(0, 0, 0);
  return NSVCD_OK;
}

// Of parts that touch: how deep, where, along which normal, and how that shrinks.
static nsvcd_result nsvcd__touching_gap(nsvcd_checker *c, nsvcd_question question,
                                        const nsvcd_gap_options *o, nsvcd_gap *gap) {
  const nsvcd_body_pair *both = &c->scene->pairs[gap->pair];
  nsvcd_answer found;
  nsvcd__d3 lift = {0, 0, 0};
  double low = 0;  // share of the lift: they touch there; and they do not
  double high = 1;
  question.ask = NSVCD_ASK_HIT;
  question.to = 0;
  nsvcd_result result = nsvcd__parting_lift(c, question, o->deepest, &lift);
  const double length = nsvcd__d3_length(lift);
  if (result || !(length > 0)) return result;
  for (size_t n = 0; n < NSVCD__DEPTH_HALVINGS && !result; n++) {
    const double middle = 0.5 * (low + high);
    result = nsvcd__ask_lifted(c, &question, nsvcd__d3_scale(lift, middle), &found);
    *(!result && found.verdict == NSVCD_FREE ? &high : &low) = middle;
  }
  if (result) return result;
  // a little beyond, which faces are near
  const double beyond = NSVCD__DEPTH_BEYOND * high + (double)o->to / length;
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = 0.1f * o->to;
  result = nsvcd__ask_lifted(c, &question, nsvcd__d3_scale(lift, beyond), &found);
  if (result) return result;
  const nsvcd__d3 along = nsvcd__d3_scale(lift, 1 / length);
  const nsvcd__d3 normal = nsvcd__d3_load(found.nearest.normal);
  const nsvcd__d3 point = nsvcd__d3_load(found.nearest.point);
  gap->depth = nsvcd__round_outward(high * length);
  gap->contact = found.nearest;
  gap->contact.gap = 0;
  nsvcd__f3_store(nsvcd__f3_round(along), gap->contact.normal);
  // a lift parts the two faces slower than it goes, unless it is along their normal
  const double rate = nsvcd__d3_dot(along, normal);
  if (!(rate > NSVCD__LEAST_RATE)) return NSVCD_OK;
  const nsvcd__d3 on_a = nsvcd__d3_fma(-high, lift, point);
  nsvcd__slope_add(c, both->a, on_a, normal, 1 / rate, gap->slope);
  nsvcd__slope_add(c, both->b, point, normal, -1 / rate, gap->slope);
  return NSVCD_OK;
}

// The gap of a pair where it stands. *is_near: it is within.
static nsvcd_result nsvcd__gap_of(nsvcd_checker *c, size_t pair, const nsvcd_gap_options *o,
                                  nsvcd_gap *gap, int *is_near) {
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  const nsvcd__member *members[2] = {&c->members[both->a], &c->members[both->b]};
  nsvcd_answer found;
  // poses in float are off by so much, at most
  const double off = 2 * (members[0]->rounding + members[1]->rounding);
  const double within = (double)o->within + off;
  *is_near = 0;
  if (nsvcd__boxes_apart(&members[0]->box, &members[1]->box, 1.000001 * within))
    return NSVCD_OK;
  nsvcd_question question = nsvcd__standing_question(c, both, o->work);
  question.clearance = nsvcd__round_outward(within);
  nsvcd_result result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result || found.verdict == NSVCD_FREE) return result;
  question.clearance = 0;
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = o->to;
  result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result) return result;
  *is_near = 1;
  memset(gap, 0, sizeof *gap);
  gap->pair = pair;
  gap->verdict = found.verdict;
  gap->why = found.why;
  gap->contact = found.nearest;
  if (found.verdict == NSVCD_HIT) {
    gap->distance.high = nsvcd__round_outward(off);
    gap->depth = HUGE_VALF;
    return found.inside ? NSVCD_OK : nsvcd__touching_gap(c, question, o, gap);
  }
  gap->distance.high = nsvcd__round_outward((double)found.distance.high + off);
  gap->distance.low = (float)nsvcd__max((double)found.distance.low * (1 - 1e-7) - off, 0);
  // of both at the point on b: that on a is off it along the normal, and no turn changes that
  const nsvcd__d3 normal = nsvcd__d3_load(gap->contact.normal);
  const nsvcd__d3 point = nsvcd__d3_load(gap->contact.point);
  nsvcd__slope_add(c, both->a, point, normal, 1, gap->slope);
  nsvcd__slope_add(c, both->b, point, normal, -1, gap->slope);
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_gaps(nsvcd_checker *checker, const double *joints,
                                 const nsvcd_gap_options *options, nsvcd_gap *gaps,
                                 size_t capacity, size_t *count) {
  nsvcd_gap_options o;
  size_t near_ones = 0;
  nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (!result && (!count || (!gaps && capacity > 0))) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  const float *lengths[3] = {&o.within, &o.to, &o.deepest};
  for (size_t n = 0; n < 3; n++) {
    if (!nsvcd__within(lengths[n], 1, NSVCD_MAX_COORDINATE) || *lengths[n] < 0)
      return NSVCD_ERROR_TOLERANCE;
  }
  o.within = o.within > 0 ? o.within : NSVCD__GAP_WITHIN;
  o.to = o.to > 0 ? o.to : NSVCD__GAP_TO;
  o.deepest = o.deepest > 0 ? o.deepest : NSVCD__GAP_DEEPEST;
  nsvcd__stand(checker, joints);
  for (size_t n = 0; n < checker->scene->pair_count && !result; n++) {
    nsvcd_gap gap;
    int is_near;
    result = nsvcd__gap_of(checker, n, &o, &gap, &is_near);
    if (result || !is_near) continue;
    if (near_ones < capacity) gaps[near_ones] = gap;
    near_ones++;
  }
  if (!result) *count = near_ones;
  return result;
}

// ---- a way out

static void nsvcd__take_into_limits(const nsvcd_scene *scene, double *joints) {
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
    const double low = is_endless ? -(double)NSVCD_MAX_COORDINATE : joint->low;
    const double high = is_endless ? (double)NSVCD_MAX_COORDINATE : joint->high;
    joints[j] = nsvcd__max(low, nsvcd__min(high, joints[j]));
  }
}

static nsvcd_result nsvcd__is_free_at(nsvcd_checker *c, const double *joints, float clearance,
                                      int *is_free) {
  const nsvcd_joint_motion still = {0, 0, joints, NULL};
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&options, 0, sizeof options);
  options.clearance = clearance;
  const nsvcd_result result = nsvcd_check(c, &still, &options, &answer);
  *is_free = !result && answer.verdict == NSVCD_FREE && answer.joint == NSVCD_NONE;
  return result;
}

// From a place that is free back towards `from`, which is not, as far as that stays free.
static nsvcd_result nsvcd__draw_back(nsvcd_checker *c, const double *from, float clearance,
                                     double *at) {
  const size_t joints = c->scene->joint_count;
  double blocked[NSVCD_MAX_JOINTS];
  nsvcd_result result = NSVCD_OK;
  memcpy(blocked, from, joints * sizeof *at);
  for (size_t n = 0; n < NSVCD__ESCAPE_HALVINGS && !result; n++) {
    double middle[NSVCD_MAX_JOINTS];
    int is_free;
    for (size_t j = 0; j < joints; j++) middle[j] = 0.5 * (blocked[j] + at[j]);
    result = nsvcd__is_free_at(c, middle, clearance, &is_free);
    if (!result) memcpy(is_free ? at : blocked, middle, joints * sizeof *at);
  }
  return result;
}

// Draws on spheres about `from`, from the inside to the outside, until one is free; then on ever
// smaller ones, nearer than the best.
static nsvcd_result nsvcd__seek_escape(nsvcd_checker *c, const double *from, float clearance,
                                       double farthest, uint64_t random, double *out,
                                       int *is_found) {
  const size_t joints = c->scene->joint_count;
  double best = farthest;
  *is_found = 0;
  for (size_t n = 0; n < NSVCD__ESCAPE_RINGS * NSVCD__ESCAPE_DRAWS; n++) {
    const double ring = (double)(n / NSVCD__ESCAPE_DRAWS + 1) / NSVCD__ESCAPE_RINGS;
    const double radius = *is_found ? NSVCD__ESCAPE_NEARER * best : ring * farthest;
    double at[NSVCD_MAX_JOINTS];
    double square = 0;
    int is_free;
    for (size_t j = 0; j < joints; j++) {
      at[j] = 2 * nsvcd__random(&random) - 1;
      square += at[j] * at[j];
    }
    for (size_t j = 0; j < joints; j++) at[j] = from[j] + radius / sqrt(square) * at[j];
    nsvcd__take_into_limits(c->scene, at);
    nsvcd_result result = nsvcd__is_free_at(c, at, clearance, &is_free);
    if (result) return result;
    if (!is_free) continue;
    result = nsvcd__draw_back(c, from, clearance, at);
    if (result) return result;
    *is_found = 1;
    best = sqrt(nsvcd__way2(at, from, joints));
    memcpy(out, at, joints * sizeof *at);
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_escape(nsvcd_checker *checker, const double *joints,
                                   const nsvcd_escape_options *options, double *out,
                                   int *is_found) {
  nsvcd_escape_options o;
  double from[NSVCD_MAX_JOINTS], at[NSVCD_MAX_JOINTS];
  nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (!result && (!out || !is_found)) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  const size_t bytes = checker->scene->joint_count * sizeof(double);
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__within(&o.clearance, 1, 0.5f * NSVCD_MAX_COORDINATE) || o.clearance < 0)
    return NSVCD_ERROR_TOLERANCE;
  if (!nsvcd__is_number(o.farthest, (double)NSVCD_MAX_COORDINATE) || o.farthest < 0)
    return NSVCD_ERROR_NUMBER;
  const double farthest = o.farthest > 0 ? o.farthest : NSVCD__FARTHEST_ESCAPE;
  memcpy(from, joints, bytes);
  nsvcd__take_into_limits(checker->scene, from);
  int is_free;
  memcpy(at, from, bytes);
  result = nsvcd__is_free_at(checker, from, o.clearance, &is_free);
  if (!result && !is_free)
    result = nsvcd__seek_escape(checker, from, o.clearance + NSVCD__ESCAPE_ROOM, farthest,
                                o.seed, at, &is_free);
  if (result) return result;
  *is_found = is_free;
  if (is_free) memcpy(out, at, bytes);
  return NSVCD_OK;
}

// ---- pairs

// Do two parts touch in so many configurations, drawn within the limits?
static nsvcd_result nsvcd__touch_always(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                        size_t samples, uint64_t random, int *always) {
  nsvcd_answer found;
  nsvcd_result result = NSVCD_OK;
  *always = 1;
  for (size_t n = 0; n < samples && *always && !result; n++) {
    double joints[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < c->scene->joint_count; j++) {
      const nsvcd_joint *joint = &c->scene->joints[j];
      const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
      const double low = is_endless ? 0 : joint->low;
      const double high = is_endless ? 6.283185307179586 : joint->high;
      joints[j] = low + (high - low) * nsvcd__random(&random);
    }
    nsvcd__stand(c, joints);
    const nsvcd_question question = nsvcd__standing_question(c, pair, 0);
    result = nsvcd_sweep(&question, c->query, c->query_size, &found);
    *always = !result && found.verdict == NSVCD_HIT;
  }
  return result;
}

// Does one joint part two links, neither of them the world?
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

NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t samples, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts) {
  if (!checker || !counts || (!pairs && capacity > 0)) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  nsvcd_body_pair pair = {0, 0};
  nsvcd_pair_counts found = {0, 0, 0};
  size_t total = 0;
  while (nsvcd__next_pair(scene, &pair)) total++;
  if (capacity < total) return NSVCD_ERROR_WORKSPACE;
  // what is asked from the front, what always touches from the back
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    int always;
    if (nsvcd__are_adjacent(scene, &pair)) continue;
    const nsvcd_result result = nsvcd__touch_always(
        checker, &pair, samples ? samples : NSVCD__PAIR_SAMPLES, seed, &always);
    if (result) return result;
    pairs[always ? total - ++found.touching : found.asked++] = pair;
  }
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    if (nsvcd__are_adjacent(scene, &pair)) pairs[found.asked + found.adjacent++] = pair;
  }
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

NSVCDDEF nsvcd_result nsvcd_hand_over(const nsvcd_checker *checker, const double *joints,
                                      size_t part, uint32_t link, nsvcd_part *out) {
  nsvcd__configuration c;
  const nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (result) return result;
  const nsvcd_scene *scene = checker->scene;
  if (!out || part >= scene->part_count || link > scene->joint_count)
    return NSVCD_ERROR_ARGUMENT;
  memcpy(c.joints, joints, scene->joint_count * sizeof *joints);
  nsvcd__place_links(checker, &c);
  const nsvcd__frame at = nsvcd__frame_of_part(checker, &c, part);
  const nsvcd__frame *to = &c.frames[link];
  const nsvcd__dquat back = {-to->turn.x, -to->turn.y, -to->turn.z, to->turn.w};
  const nsvcd__frame inner = {nsvcd__dquat_inverse_mul(to->turn, at.turn),
                              nsvcd__dquat_rotate(back, nsvcd__d3_sub(at.place, to->place))};
  nsvcd_part moved = scene->parts[part];
  moved.link = link;
  moved.pose = nsvcd__pose_in(&inner);
  if (!nsvcd__poses_are_valid(&moved.pose, 1)) return NSVCD_ERROR_POSE;
  *out = moved;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------------- robot/ramps
// In: two states, places and speeds of the joints, and limits of speed and acceleration. Out: a
// motion from one to the other in the least time of the slowest joint, each of the others with the
// least acceleration that takes as long.
//
// A joint speeds up, and down again, or the other way round; where it would be too fast in between,
// it goes on at the limit. What it does is of degree 2 piece by piece.
// Source: Hauser and Ng-Thow-Hing (2010).

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// of a ramp: each joint has two times at which its acceleration changes
#define NSVCD__RAMP_PIECES (2 * NSVCD_MAX_JOINTS + 1)
// share of the limits of speed and acceleration that is asked for: the rest is for rounding
#define NSVCD__RAMP_SHARE (1 - 1e-6)
#define NSVCD__RAMP_MOST (1 - 5e-7)
// seconds: of shorter pieces rounding would say what their acceleration is; there are none. And two
// changes no farther apart than that are one
#define NSVCD__SLIVER 1e-4
#define NSVCD__SAME_TIME 1e-12

static double nsvcd__speed_of(const nsvcd_joint *joint) {
  return joint->speed > 0 ? joint->speed : 1;
}
static double nsvcd__acceleration_of(const nsvcd_joint *joint) {
  return joint->acceleration > 0 ? joint->acceleration : 1;
}

// A joint's way in a ramp: acceleration a until t1, none until t2, -a after that.
typedef struct nsvcd__ramp_joint {
  double a, t1, t2;
} nsvcd__ramp_joint;

// The least time from place x0 and speed v0 to x1 and v1, both within the limits.
static double nsvcd__ramp_time(double x0, double v0, double x1, double v1, double speed,
                               double most) {
  const double way = x1 - x0;
  // changing speed takes this way: is there more to go, or less?
  const double least = 0.5 * (v0 + v1) * fabs(v1 - v0) / most;
  const double side = way >= least ? 1 : -1;
  const double peak2 = side * most * way + 0.5 * (v0 * v0 + v1 * v1);
  const double peak = side * sqrt(nsvcd__max(peak2, 0));
  if (fabs(peak) <= speed) return (fabs(peak - v0) + fabs(peak - v1)) / most;
  const double fast = side * speed;
  const double changing = (speed * speed - 0.5 * (v0 * v0 + v1 * v1)) / (side * most);
  return (fabs(fast - v0) + fabs(fast - v1)) / most + nsvcd__max((way - changing) / fast, 0);
}

// The way with the least acceleration that takes this time. Returns 0 if there is none within the
// limits.
static int nsvcd__ramp_solve(double x0, double v0, double x1, double v1, double speed,
                             double most, double time, nsvcd__ramp_joint *out) {
  const double way = x1 - x0;
  const double change = v1 - v0;
  // time^2 a^2 + b a - change^2 = 0: the root of the greater size
  const double b = 2 * time * (v0 + v1) - 4 * way;
  const double root = sqrt(b * b + 4 * time * time * change * change);
  double a = -(b + (b > 0 ? root : -root)) / (2 * time * time);
  out->t1 = 0.5 * time;
  if (a > 0 || a < 0) out->t1 += 0.5 * change / a;
  out->t1 = nsvcd__max(0, nsvcd__min(time, out->t1));
  out->t2 = out->t1;
  const double peak = v0 + a * out->t1;
  if (fabs(peak) > speed) {
    const double fast = peak > 0 ? speed : -speed;
    const double up = (fast - v0) * (fast - v0) + (fast - v1) * (fast - v1);
    a = up / (2 * (fast * time - way));
    if (!(a * fast > 0)) return 0;
    out->t1 = (fast - v0) / a;
    out->t2 = time - (fast - v1) / a;
    if (!(out->t1 >= 0 && out->t2 >= out->t1 && out->t2 <= time)) return 0;
  }
  out->a = a;
  return fabs(a) <= most;
}

// Place and speed at a time of a way that begins with x0 and v0.
static void nsvcd__ramp_at(const nsvcd__ramp_joint *r, double x0, double v0, double t,
                           double *x, double *v) {
  const double up = nsvcd__min(t, r->t1);
  const double even = nsvcd__max(nsvcd__min(t, r->t2) - r->t1, 0);
  const double down = nsvcd__max(t - r->t2, 0);
  const double fast = v0 + r->a * up;
  *x = x0 + (0.5 * (v0 + fast)) * up + fast * even + (fast - 0.5 * r->a * down) * down;
  *v = fast - r->a * down;
}

// Does a joint turn round out of its limits on the way? Its ends are within.
static int nsvcd__ramp_leaves(const nsvcd_joint *joint, const nsvcd__ramp_joint *r, double x0,
                              double v0, double time) {
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return 0;
  // where it stands still
  const double turns[2] = {
      r->a * v0 < 0 ? -v0 / r->a : 0,
      r->a * (v0 + r->a * r->t1) > 0 ? r->t2 + (v0 + r->a * r->t1) / r->a : 0};
  for (size_t k = 0; k < 2; k++) {
    double x, v;
    const int is_there = k ? turns[k] > r->t2 && turns[k] < time : turns[k] < r->t1;
    if (!is_there || !(turns[k] > 0)) continue;
    nsvcd__ramp_at(r, x0, v0, turns[k], &x, &v);
    if (x < joint->low || x > joint->high) return 1;
  }
  return 0;
}

// Writes a ramp of all joints as pieces: points (2 pieces + 1, F), times from 0. state: the joints
// at the start and the end, and their speeds (4, F). Returns the pieces; 0 if there is no ramp
// within the limits that takes less than `longest`, or two of its changes nearly coincide.
static size_t nsvcd__ramp_write(const nsvcd_scene *scene, double states[4][NSVCD_MAX_JOINTS],
                                double longest, double *points, double *times) {
  const size_t joints = scene->joint_count;
  nsvcd__ramp_joint ramps[NSVCD_MAX_JOINTS];
  double changes[NSVCD__RAMP_PIECES + 1];
  size_t count = 0;
  double time = 0;
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    time = nsvcd__max(time,
                      nsvcd__ramp_time(states[0][j], states[2][j], states[1][j], states[3][j],
                                       NSVCD__RAMP_SHARE * nsvcd__speed_of(joint),
                                       NSVCD__RAMP_SHARE * nsvcd__acceleration_of(joint)));
  }
  if (!(time < longest)) return 0;
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    const double speed = NSVCD__RAMP_SHARE * nsvcd__speed_of(joint);
    const double most = NSVCD__RAMP_MOST * nsvcd__acceleration_of(joint);
    if (!nsvcd__ramp_solve(states[0][j], states[2][j], states[1][j], states[3][j], speed, most,
                           time, &ramps[j]))
      return 0;
    if (nsvcd__ramp_leaves(joint, &ramps[j], states[0][j], states[2][j], time)) return 0;
    changes[count++] = ramps[j].t1;
    changes[count++] = ramps[j].t2;
  }
  changes[count++] = time;
  // sorted, by insertion
  for (size_t k = 1; k < count; k++) {
    const double own = changes[k];
    size_t at = k;
    for (; at > 0 && changes[at - 1] > own; at--) changes[at] = changes[at - 1];
    changes[at] = own;
  }
  size_t pieces = 0;
  times[0] = 0;
  memcpy(points, states[0], joints * sizeof *points);
  for (size_t k = 0; k < count; k++) {
    if (changes[k] - times[pieces] <= NSVCD__SAME_TIME) continue;
    if (changes[k] - times[pieces] < NSVCD__SLIVER) return 0;
    const double before = times[pieces];
    const double half = 0.5 * (changes[k] - before);
    double *to = points + 2 * pieces * joints;
    for (size_t j = 0; j < joints; j++) {
      double x, v;
      nsvcd__ramp_at(&ramps[j], states[0][j], states[2][j], before, &x, &v);
      to[joints + j] = to[j] + half * v;
      nsvcd__ramp_at(&ramps[j], states[0][j], states[2][j], changes[k], &x, &v);
      to[2 * joints + j] = x;
    }
    times[++pieces] = changes[k];
  }
  memcpy(points + 2 * pieces * joints, states[1], joints * sizeof *points);
  return pieces;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------------ robot/smooth
// In: a way, a polyline that is proven. Out: a motion in time along it, then one that is smooth.
//
// Each edge is gone along from rest to rest. Then, again and again, two times are drawn: the motion
// between them is replaced by a ramp, if that is quicker and proven. Where it still rests, the two
// times are drawn about that.
// Source: Hauser and Ng-Thow-Hing (2010).

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// of a motion, at most
#define NSVCD__MOST_PIECES 2048
// seconds: half of the windows about a rest, the widest, and how often it may be halved
#define NSVCD__HALF_WINDOW 0.8
#define NSVCD__WINDOWS 6
// of the duration without obstacles: there is nothing to win
#define NSVCD__FAST_ENOUGH 1.001
// what a ramp is to win, to be worth its proof: a share of its own time, and, unless a rest goes
// with it, of what the motion takes longer than without obstacles
#define NSVCD__LEAST_GAIN 1e-4
#define NSVCD__WORTHY_GAIN 0.02
// metres that the search stays farther away than asked for, so that the whole is proven anew
#define NSVCD__SPARE 1e-4f
// metres that a part may stray from its sweeps, at least, in the search
#define NSVCD__SEEK_FINEST 5e-4f
// units that a question of the search may take
#define NSVCD__SEEK_WORK 1000

// A motion of degree 2 that is being made.
typedef struct nsvcd__course {
  double *points;  // (2 NSVCD__MOST_PIECES + 1, F)
  double *times;   // (NSVCD__MOST_PIECES + 1)
  size_t pieces;
} nsvcd__course;

typedef struct nsvcd__router {
  nsvcd_checker *checker;
  const nsvcd_scene *scene;
  size_t joints;
  nsvcd_route_problem problem;
  nsvcd_route_options options;
  nsvcd_check_options check;
  uint64_t random;
  int is_stopped;
  nsvcd__tree trees[2];  // from the start, from the goals
  // (F): the range of their roots
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  size_t *goals;  // (G): of those that are free, which; the roots of trees[1]
  double *way;    // (nodes of both trees + shortcuts, F)
  size_t way_count;
  nsvcd__course course, other, ramp;
  nsvcd_route_answer answer;
} nsvcd__router;

static nsvcd_joint_motion nsvcd__motion_of(const nsvcd__course *course) {
  const nsvcd_joint_motion out = {course->pieces, 2, course->points, course->times};
  return out;
}

// Is a motion proven free, and within the limits? answer.check says what is wrong.
static nsvcd_result nsvcd__prove_by(nsvcd__router *r, const nsvcd_joint_motion *motion,
                                    const nsvcd_check_options *options, int *is_free) {
  r->answer.checks++;
  const nsvcd_result result = nsvcd_check(r->checker, motion, options, &r->answer.check);
  *is_free =
      !result && r->answer.check.verdict == NSVCD_FREE && r->answer.check.joint == NSVCD_NONE;
  r->answer.proven += (size_t)*is_free;
  return result;
}

// The same by what the search asks for. What the caller stops is not free.
static nsvcd_result nsvcd__ask_motion(nsvcd__router *r, const nsvcd_joint_motion *motion,
                                      int *is_free) {
  *is_free = 0;
  if (!r->is_stopped && r->problem.stop && r->problem.stop(r->problem.user)) r->is_stopped = 1;
  return r->is_stopped ? NSVCD_OK : nsvcd__prove_by(r, motion, &r->check, is_free);
}

static nsvcd_result nsvcd__prove_edge(nsvcd__router *r, const double *from, const double *to,
                                      int *is_free) {
  double points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = {1, 1, points, NULL};
  memcpy(points, from, r->joints * sizeof *points);
  memcpy(points + r->joints, to, r->joints * sizeof *points);
  return nsvcd__ask_motion(r, &motion, is_free);
}

// Adds a piece of degree 2 from where the course is; the times rise by `time`.
static void nsvcd__course_add(nsvcd__course *c, size_t joints, const double *middle,
                              const double *end, double time) {
  double *at = c->points + (2 * c->pieces + 1) * joints;
  memcpy(at, middle, joints * sizeof *at);
  memcpy(at + joints, end, joints * sizeof *at);
  c->times[c->pieces + 1] = c->times[c->pieces] + time;
  c->pieces++;
}

static void nsvcd__course_begin(nsvcd__course *c, size_t joints, const double *at) {
  c->pieces = 0;
  c->times[0] = 0;
  memcpy(c->points, at, joints * sizeof *at);
}

// Goes along the way, with a rest at each corner. Returns 0 where there are too many. A way of one
// place is a rest, of no pieces.
static int nsvcd__course_along(nsvcd__router *r) {
  nsvcd__course *c = &r->course;
  const size_t joints = r->joints;
  if (3 * r->way_count > NSVCD__MOST_PIECES) return 0;
  nsvcd__course_begin(c, joints, r->way);
  for (size_t k = 0; k + 1 < r->way_count; k++) {
    const double *from = r->way + k * joints;
    const double *to = from + joints;
    // of the share of the edge that has been gone along
    double speed = HUGE_VAL;
    double most = HUGE_VAL;
    for (size_t j = 0; j < joints; j++) {
      const nsvcd_joint *joint = &r->scene->joints[j];
      const double d = fabs(to[j] - from[j]);
      if (!(d > 0)) continue;
      speed = nsvcd__min(speed, NSVCD__RAMP_SHARE * nsvcd__speed_of(joint) / d);
      most = nsvcd__min(most, NSVCD__RAMP_SHARE * nsvcd__acceleration_of(joint) / d);
    }
    if (!(speed < HUGE_VAL)) continue;
    const double up = nsvcd__min(speed / most, sqrt(1 / most));
    const double fast = most * up;
    const double even = (1 - fast * up) / fast;
    const double changed = 0.5 * fast * up;  // share of the edge
    const int is_even = even > NSVCD__SLIVER;
    // 0, changed, 1 - changed, 1; without an even part, a half
    const double shares[4] = {0, is_even ? changed : 0.5, is_even ? 1 - changed : 0.5, 1};
    const double middles[3] = {0, 0.5, 1};
    const double lasts[3] = {is_even ? up : 1 / fast, even, is_even ? up : 1 / fast};
    for (size_t n = 0; n < 3; n++) {
      double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
      if (n == 1 && !is_even) continue;
      for (size_t j = 0; j < joints; j++) {
        middle[j] = from[j] + middles[n] * (to[j] - from[j]);
        end[j] = n == 2 ? to[j] : from[j] + shares[n + 1] * (to[j] - from[j]);
      }
      nsvcd__course_add(c, joints, middle, end, lasts[n]);
    }
  }
  return 1;
}

// Is the motion at rest where a piece begins?
static int nsvcd__rests_at(const nsvcd__course *c, size_t joints, size_t piece) {
  const double *at = c->points + 2 * piece * joints;
  for (size_t j = 0; j < joints; j++) {
    if (fabs(at[j + joints] - at[j]) > 1e-12 * (1 + fabs(at[j]))) return 0;
  }
  return 1;
}

// Copies the course from time t0 to t1 to the end of another. Returns 0 where a sliver would be
// left, or there is no room.
static int nsvcd__course_copy(const nsvcd__course *c, size_t joints, double t0, double t1,
                              nsvcd__course *out) {
  const nsvcd_joint_motion motion = nsvcd__motion_of(c);
  for (size_t p = nsvcd__piece_at(&motion, t0); p < c->pieces && c->times[p] < t1; p++) {
    const double from = nsvcd__max(t0, c->times[p]);
    const double to = nsvcd__min(t1, c->times[p + 1]);
    double middle[NSVCD_MAX_JOINTS], end[NSVCD_MAX_JOINTS];
    if (to - from <= NSVCD__SAME_TIME) continue;
    if (to - from < NSVCD__SLIVER || out->pieces == NSVCD__MOST_PIECES) return 0;
    for (size_t j = 0; j < joints; j++) {
      double points[NSVCD_MAX_DEGREE + 1];
      nsvcd__joint_points(&motion, p, joints, j, points);
      nsvcd__cut_curve(points, 2, nsvcd__share_at(&motion, p, from),
                       nsvcd__share_at(&motion, p, to));
      middle[j] = points[1];
      end[j] = points[2];
    }
    nsvcd__course_add(out, joints, middle, end, to - from);
  }
  return 1;
}

// Replaces the course from time t0 to t1 by a ramp, if that is quicker by `gain` and proven.
static nsvcd_result nsvcd__smooth_once(nsvcd__router *r, double t0, double t1, double gain) {
  const size_t joints = r->joints;
  double states[4][NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = nsvcd__motion_of(&r->course);
  const double times[2] = {t0, t1};
  for (size_t n = 0; n < 2; n++) {
    const size_t piece = nsvcd__piece_at(&motion, times[n]);
    nsvcd__joints_at(&motion, joints, piece, nsvcd__share_at(&motion, piece, times[n]),
                     states[n], states[n + 2]);
  }
  nsvcd__course *ramp = &r->ramp;
  ramp->pieces =
      nsvcd__ramp_write(r->scene, states, t1 - t0 - gain, ramp->points, ramp->times);
  if (!ramp->pieces) return NSVCD_OK;
  // the whole as it would be: what is left of the course, and the ramp between
  nsvcd__course *out = &r->other;
  nsvcd__course_begin(out, joints, r->course.points);
  const double end = r->course.times[r->course.pieces];
  if (!nsvcd__course_copy(&r->course, joints, 0, t0, out)) return NSVCD_OK;
  if (out->pieces + ramp->pieces > NSVCD__MOST_PIECES) return NSVCD_OK;
  for (size_t p = 0; p < ramp->pieces; p++) {
    const double *middle = ramp->points + (2 * p + 1) * joints;
    nsvcd__course_add(out, joints, middle, middle + joints,
                      ramp->times[p + 1] - ramp->times[p]);
  }
  if (!nsvcd__course_copy(&r->course, joints, t1, end, out)) return NSVCD_OK;
  int is_free;
  const nsvcd_joint_motion asked = nsvcd__motion_of(ramp);
  const nsvcd_result result = nsvcd__ask_motion(r, &asked, &is_free);
  if (result || !is_free) return result;
  const nsvcd__course was = r->course;
  r->course = r->other;
  r->other = was;
  return NSVCD_OK;
}

static nsvcd_result nsvcd__smooth(nsvcd__router *r) {
  for (size_t n = 0; n < r->options.smoothings && !r->is_stopped; n++) {
    const nsvcd__course *c = &r->course;
    const double end = c->times[c->pieces];
    if (end <= NSVCD__FAST_ENOUGH * r->answer.unhindered) return NSVCD_OK;
    double t0 = end * nsvcd__random(&r->random);
    double t1 = end * nsvcd__random(&r->random);
    size_t rests = 0;
    double rest = 0;
    for (size_t p = 1; p < c->pieces && n % 2; p++) {
      // each as likely as the others
      if (!nsvcd__rests_at(c, r->joints, p)) continue;
      if (nsvcd__random(&r->random) * (double)++rests <= 1) rest = c->times[p];
    }
    if (rests > 0) {
      const double window =
          NSVCD__HALF_WINDOW /
          (double)(1 << (size_t)(NSVCD__WINDOWS * nsvcd__random(&r->random)));
      t0 = nsvcd__max(0, rest - window);
      t1 = nsvcd__min(end, rest + window);
    }
    const double least = NSVCD__LEAST_GAIN * fabs(t1 - t0);
    const double worthy = NSVCD__WORTHY_GAIN * (end - r->answer.unhindered);
    const nsvcd_result result = nsvcd__smooth_once(r, nsvcd__min(t0, t1), nsvcd__max(t0, t1),
                                                   rests ? least : nsvcd__max(least, worthy));
    if (result) return result;
  }
  return NSVCD_OK;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ------------------------------------------------------------------------------------- robot/route
// In: a start and goals. Out: a motion that is proven free, in the caller's memory.

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
#define NSVCD__NODES 20000
#define NSVCD__SHORTCUTS 20
#define NSVCD__SMOOTHINGS 200
// of all joints whose limits are wider, only what is no farther than this from the start and the
// goals is drawn from, but for one configuration in eight
#define NSVCD__BESIDE 3.2
// radians or metres: corners of a way that are no farther apart are one
#define NSVCD__SAME_CORNER 1e-9

// ---- memory

static nsvcd_result nsvcd__route_check(const nsvcd_checker *checker,
                                       const nsvcd_route_problem *problem,
                                       const nsvcd_route_options *options) {
  if (!checker || !problem || !problem->start || !problem->goals) return NSVCD_ERROR_ARGUMENT;
  const size_t most = NSVCD_MAX_NODES;
  if (problem->goal_count < 1 || problem->goal_count > most) return NSVCD_ERROR_ARGUMENT;
  if (problem->guess ? problem->guess_count > most : problem->guess_count > 0)
    return NSVCD_ERROR_ARGUMENT;
  if (options && (options->nodes > most || !(options->edge >= 0))) return NSVCD_ERROR_ARGUMENT;
  if (options && options->shortcuts > most && options->shortcuts != NSVCD_NONE)
    return NSVCD_ERROR_ARGUMENT;
  const double *rows[3] = {problem->start, problem->goals, problem->guess};
  const size_t counts[3] = {1, problem->goal_count, problem->guess_count};
  for (size_t n = 0; n < 3; n++) {
    for (size_t k = 0; k < counts[n] * checker->scene->joint_count; k++) {
      if (!nsvcd__is_number(rows[n][k], (double)NSVCD_MAX_COORDINATE))
        return NSVCD_ERROR_NUMBER;
    }
  }
  return NSVCD_OK;
}

static void nsvcd__course_take(nsvcd__course *c, char *base, uint64_t *used, size_t pieces,
                               size_t joints) {
  c->points = (double *)nsvcd__take(base, used, (2 * pieces + 1) * joints, sizeof(double));
  c->times = (double *)nsvcd__take(base, used, pieces + 1, sizeof(double));
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
  o->edge = o->edge > 0 ? o->edge : 1;
  if (!o->shortcuts) o->shortcuts = NSVCD__SHORTCUTS;
  if (!o->smoothings) o->smoothings = NSVCD__SMOOTHINGS;
  if (o->shortcuts == NSVCD_NONE) o->shortcuts = 0;
  if (o->smoothings == NSVCD_NONE) o->smoothings = 0;
  const size_t joints = checker->scene->joint_count;
  // what is given is not counted as a node
  const size_t nodes = o->nodes + problem->goal_count + problem->guess_count + 1;
  for (size_t k = 0; k < 2; k++) {
    nsvcd__tree *t = &r->trees[k];
    t->joints = joints;
    t->points = (double *)nsvcd__take(base, &used, nodes * joints, sizeof(double));
    t->parents = (uint32_t *)nsvcd__take(base, &used, nodes, sizeof(uint32_t));
    t->next = (uint32_t *)nsvcd__take(base, &used, nodes, sizeof(uint32_t));
    t->cells = (nsvcd__cell *)nsvcd__take(base, &used, 2 * nodes, sizeof(nsvcd__cell));
  }
  r->goals = (size_t *)nsvcd__take(base, &used, problem->goal_count, sizeof(size_t));
  // a shortcut from an edge to the next adds a corner
  const size_t rows = 2 * nodes + o->shortcuts;
  r->way = (double *)nsvcd__take(base, &used, rows, joints * sizeof(double));
  nsvcd__course_take(&r->course, base, &used, NSVCD__MOST_PIECES, joints);
  nsvcd__course_take(&r->other, base, &used, NSVCD__MOST_PIECES, joints);
  nsvcd__course_take(&r->ramp, base, &used, NSVCD__RAMP_PIECES, joints);
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

// ---- trees

// A configuration in the limits, near the start and the goals or anywhere.
static void nsvcd__draw(nsvcd__router *r, double *out) {
  const int is_wide = nsvcd__random(&r->random) < 0.125;
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    double low = r->low[j] - NSVCD__BESIDE;
    double high = r->high[j] + NSVCD__BESIDE;
    if (joint->kind != NSVCD_JOINT_CONTINUOUS) {
      low = is_wide ? joint->low : nsvcd__max(low, joint->low);
      high = is_wide ? joint->high : nsvcd__min(high, joint->high);
    }
    out[j] = low + (high - low) * nsvcd__random(&r->random);
  }
}

// Grows a tree from its node nearest to a configuration, edge by edge until it is there or, unless
// `is_greedy`, once. Returns the last node that is new in *node, or the nearest one; *is_there: it
// is the configuration.
static nsvcd_result nsvcd__grow(nsvcd__router *r, nsvcd__tree *t, const double *to,
                                int is_greedy, size_t *node, int *is_there) {
  const size_t joints = r->joints;
  *node = nsvcd__tree_nearest(t, to);
  *is_there = 0;
  do {
    double next[NSVCD_MAX_JOINTS];
    const double *from = t->points + *node * joints;
    const double way = sqrt(nsvcd__way2(from, to, joints));
    const int ends = way <= r->options.edge;
    for (size_t j = 0; j < joints; j++)
      next[j] = ends ? to[j] : from[j] + r->options.edge / way * (to[j] - from[j]);
    if (!(way > 0)) {
      *is_there = 1;
      return NSVCD_OK;
    }
    int is_free;
    const nsvcd_result result = nsvcd__prove_edge(r, from, next, &is_free);
    if (result) return result;
    if (!is_free || r->trees[0].count + r->trees[1].count >= r->options.nodes) return NSVCD_OK;
    *node = nsvcd__tree_add(t, next, *node);
    *is_there = ends;
  } while (is_greedy && !*is_there);
  return NSVCD_OK;
}

// Writes the way through nodes of both trees that are at the same place.
static void nsvcd__way_through(nsvcd__router *r, size_t from_start, size_t from_goal) {
  const size_t joints = r->joints;
  const size_t bytes = joints * sizeof(double);
  const nsvcd__tree *start = &r->trees[0];
  const nsvcd__tree *goal = &r->trees[1];
  size_t count = 1;
  for (size_t n = from_start; start->parents[n] != n; n = start->parents[n]) count++;
  r->way_count = count;
  for (size_t n = from_start; count-- > 0; n = start->parents[n])
    memcpy(r->way + count * joints, start->points + n * joints, bytes);
  size_t n = from_goal;
  for (; goal->parents[n] != n; n = goal->parents[n])
    memcpy(r->way + r->way_count++ * joints, goal->points + goal->parents[n] * joints, bytes);
  r->answer.goal = r->goals[n];
}

// The way that is guessed: the trees take what is free of it from both ends.
static nsvcd_result nsvcd__take_guess(nsvcd__router *r, int *is_found) {
  const nsvcd_route_problem *p = &r->problem;
  const size_t joints = r->joints;
  size_t first = 0;
  size_t last = p->guess_count;
  size_t nodes[2] = {0, 0};
  int is_free = 1;
  // which goal it leads to
  if (last > 0) nodes[1] = nsvcd__tree_nearest(&r->trees[1], p->guess + (last - 1) * joints);
  for (int side = 0; side < 2; side++) {
    nsvcd__tree *t = &r->trees[side];
    for (is_free = 1; is_free && first < last;) {
      const double *to = p->guess + (side ? last - 1 : first) * joints;
      const nsvcd_result result =
          nsvcd__prove_edge(r, t->points + nodes[side] * joints, to, &is_free);
      if (result) return result;
      if (!is_free) continue;
      nodes[side] = nsvcd__tree_add(t, to, nodes[side]);
      first += side == 0;
      last -= side == 1;
    }
  }
  if (first < last) return NSVCD_OK;
  // what is left between
  const nsvcd_result result =
      nsvcd__prove_edge(r, r->trees[0].points + nodes[0] * joints,
                        r->trees[1].points + nodes[1] * joints, is_found);
  if (result || !*is_found) return result;
  nodes[0] = nsvcd__tree_add(&r->trees[0], r->trees[1].points + nodes[1] * joints, nodes[0]);
  nsvcd__way_through(r, nodes[0], nodes[1]);
  return NSVCD_OK;
}

static nsvcd_result nsvcd__seek(nsvcd__router *r) {
  const size_t joints = r->joints;
  int is_found = 0;
  nsvcd_result result = nsvcd__take_guess(r, &is_found);
  if (result || is_found) return result;
  // straight lines
  for (size_t g = 0; g < r->trees[1].count && g < r->problem.goal_count && !r->is_stopped;
       g++) {
    const double *goal = r->trees[1].points + g * joints;
    result = nsvcd__prove_edge(r, r->trees[0].points, goal, &is_found);
    if (result) return result;
    if (!is_found) continue;
    nsvcd__way_through(r, nsvcd__tree_add(&r->trees[0], goal, 0), g);
    return NSVCD_OK;
  }
  for (size_t turn = 0; !r->is_stopped; turn++) {
    nsvcd__tree *grown = &r->trees[turn % 2];
    nsvcd__tree *other = &r->trees[1 - turn % 2];
    double drawn[NSVCD_MAX_JOINTS];
    size_t node, met;
    int is_there;
    nsvcd__draw(r, drawn);
    const size_t before = grown->count;
    result = nsvcd__grow(r, grown, drawn, 0, &node, &is_there);
    if (result) return result;
    if (r->trees[0].count + r->trees[1].count >= r->options.nodes) return NSVCD_OK;
    if (grown->count == before) continue;
    result = nsvcd__grow(r, other, grown->points + node * joints, 1, &met, &is_there);
    if (result) return result;
    if (!is_there) continue;
    nsvcd__way_through(r, turn % 2 ? met : node, turn % 2 ? node : met);
    return NSVCD_OK;
  }
  return NSVCD_OK;
}

// ---- shortcuts

// A place on the way, this far along it: the corner before and the place.
static size_t nsvcd__way_at(const nsvcd__router *r, double gone, double *at) {
  const size_t joints = r->joints;
  size_t k = 0;
  for (; k + 2 < r->way_count; k++) {
    const double *from = r->way + k * joints;
    const double length = sqrt(nsvcd__way2(from, from + joints, joints));
    if (gone <= length) break;
    gone -= length;
  }
  const double *from = r->way + k * joints;
  const double length = sqrt(nsvcd__way2(from, from + joints, joints));
  const double share = length > 0 ? nsvcd__min(gone / length, 1) : 0;
  for (size_t j = 0; j < joints; j++) at[j] = from[j] + share * (from[j + joints] - from[j]);
  return k;
}

// Replaces what is between two places on the way by an edge, again and again, where that is free.
static nsvcd_result nsvcd__shorten(nsvcd__router *r) {
  const size_t joints = r->joints;
  for (size_t n = 0; n < r->options.shortcuts && r->way_count > 2 && !r->is_stopped; n++) {
    double at[2][NSVCD_MAX_JOINTS];
    double length = 0;
    for (size_t k = 0; k + 1 < r->way_count; k++)
      length += sqrt(nsvcd__way2(r->way + k * joints, r->way + (k + 1) * joints, joints));
    const double a = length * nsvcd__random(&r->random);
    const double b = length * nsvcd__random(&r->random);
    const size_t first = nsvcd__way_at(r, nsvcd__min(a, b), at[0]);
    const size_t last = nsvcd__way_at(r, nsvcd__max(a, b), at[1]);
    // on one edge there is nothing to win, and the way grows by a corner where none is cut off
    if (first == last) continue;
    int is_free;
    const nsvcd_result result = nsvcd__prove_edge(r, at[0], at[1], &is_free);
    if (result) return result;
    if (!is_free) continue;
    // corners first + 1 to last make way for two
    const size_t rest = r->way_count - (last + 1);
    memmove(r->way + (first + 3) * joints, r->way + (last + 1) * joints,
            rest * joints * sizeof(double));
    memcpy(r->way + (first + 1) * joints, at[0], joints * sizeof(double));
    memcpy(r->way + (first + 2) * joints, at[1], joints * sizeof(double));
    r->way_count = first + 3 + rest;
  }
  return NSVCD_OK;
}

// Drops corners that are nearly at the one before: of so short an edge rounding would say what its
// acceleration is. What is timed is proven as a whole.
static void nsvcd__thin_way(nsvcd__router *r) {
  const size_t joints = r->joints;
  const size_t bytes = joints * sizeof(double);
  const double least = NSVCD__SAME_CORNER * NSVCD__SAME_CORNER;
  const double *last = r->way + (r->way_count - 1) * joints;
  size_t kept = 1;
  for (size_t k = 1; k < r->way_count; k++) {
    const double *at = r->way + k * joints;
    if (nsvcd__way2(r->way + (kept - 1) * joints, at, joints) < least) continue;
    memmove(r->way + kept++ * joints, at, bytes);
  }
  // the end stays where it is
  memmove(r->way + (kept - 1) * joints, last, bytes);
  r->way_count = kept;
}

// ---- a route

NSVCDDEF const char *nsvcd_route_status_string(nsvcd_route_status status) {
  switch (status) {
    case NSVCD_ROUTE_FOUND:
      return "found";
    case NSVCD_ROUTE_LIMIT:
      return "no way found with so many nodes";
    case NSVCD_ROUTE_STOPPED:
      return "stopped";
    case NSVCD_ROUTE_START:
      return "start not free";
    case NSVCD_ROUTE_GOAL:
      return "no goal free";
  }
  return "not a status";
}

// A configuration in *out, taken into the limits where rounding has it out. Is it free?
static nsvcd_result nsvcd__take_in(nsvcd__router *r, const double *at, double *out,
                                   int *is_free) {
  const nsvcd_joint_motion motion = {0, 0, out, NULL};
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double off = nsvcd__limit_off(joint);
    out[j] = at[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    if (at[j] < joint->low && at[j] >= joint->low - off) out[j] = joint->low;
    if (at[j] > joint->high && at[j] <= joint->high + off) out[j] = joint->high;
  }
  nsvcd_result result = nsvcd__ask_motion(r, &motion, is_free);
  if (result || *is_free || !(r->check.clearance > r->options.clearance)) return result;
  // nothing to spare here
  const float was = r->check.clearance;
  r->check.clearance = r->options.clearance;
  result = nsvcd__ask_motion(r, &motion, is_free);
  if (!result && !*is_free) r->check.clearance = was;
  return result;
}

// Adds a root to a tree, and takes it into the range of all roots.
static void nsvcd__plant_root(nsvcd__router *r, nsvcd__tree *t, const double *at) {
  const int is_first = r->trees[0].count == 0;
  for (size_t j = 0; j < r->joints; j++) {
    r->low[j] = is_first ? at[j] : nsvcd__min(r->low[j], at[j]);
    r->high[j] = is_first ? at[j] : nsvcd__max(r->high[j], at[j]);
  }
  nsvcd__tree_add(t, at, t->count);
}

// Roots of the trees. Sets the status where there are none.
static nsvcd_result nsvcd__plant(nsvcd__router *r) {
  double at[NSVCD_MAX_JOINTS];
  int is_free;
  nsvcd_result result = nsvcd__take_in(r, r->problem.start, at, &is_free);
  if (result) return result;
  if (!is_free) r->answer.status = NSVCD_ROUTE_START;
  if (!is_free) return NSVCD_OK;
  nsvcd__plant_root(r, &r->trees[0], at);
  for (size_t g = 0; g < r->problem.goal_count && !result; g++) {
    result = nsvcd__take_in(r, r->problem.goals + g * r->joints, at, &is_free);
    if (result || !is_free) continue;
    // as near as whole turns bring it
    for (size_t j = 0; j < r->joints; j++) {
      const double turns = floor((at[j] - r->trees[0].points[j]) / 6.283185307179586 + 0.5);
      if (r->scene->joints[j].kind == NSVCD_JOINT_CONTINUOUS)
        at[j] -= 6.283185307179586 * turns;
    }
    r->goals[r->trees[1].count] = g;
    nsvcd__plant_root(r, &r->trees[1], at);
  }
  if (!r->trees[1].count) r->answer.status = NSVCD_ROUTE_GOAL;
  return result;
}

// From the way to a motion, proven as it is: smooth, else with a rest at each corner.
static nsvcd_result nsvcd__time_way(nsvcd__router *r) {
  const size_t joints = r->joints;
  const double *last = r->way + (r->way_count - 1) * joints;
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double time = nsvcd__ramp_time(r->way[j], 0, last[j], 0, nsvcd__speed_of(joint),
                                         nsvcd__acceleration_of(joint));
    r->answer.unhindered = nsvcd__max(r->answer.unhindered, time);
  }
  int is_free = 0;
  nsvcd_check_options whole;
  memset(&whole, 0, sizeof whole);
  whole.clearance = r->options.clearance;
  for (int rests = 0; rests < 2 && !is_free; rests++) {
    nsvcd_result result = NSVCD_OK;
    if (!nsvcd__course_along(r)) break;
    if (!rests) result = nsvcd__smooth(r);
    if (result) return result;
    // though the search is stopped: what it has found by then is not given up
    const nsvcd_joint_motion motion = nsvcd__motion_of(&r->course);
    result = nsvcd__prove_by(r, &motion, &whole, &is_free);
    if (result) return result;
  }
  if (!is_free) return NSVCD_OK;
  nsvcd_route_answer *answer = &r->answer;
  answer->status = NSVCD_ROUTE_FOUND;
  answer->motion = nsvcd__motion_of(&r->course);
  answer->duration = r->course.times[r->course.pieces];
  for (size_t p = 1; p < r->course.pieces; p++)
    answer->stops += (size_t)nsvcd__rests_at(&r->course, joints, p);
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_route(nsvcd_checker *checker, const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, void *memory,
                                  size_t size, nsvcd_route_answer *answer) {
  nsvcd__router *r;
  nsvcd_result result = nsvcd__route_check(checker, problem, options);
  if (result) return result;
  if (!answer) return NSVCD_ERROR_ARGUMENT;
  if (options && (!nsvcd__is_finite(options->clearance) || options->clearance < 0))
    return NSVCD_ERROR_TOLERANCE;
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
  r->check.finest = NSVCD__SEEK_FINEST;
  r->check.work = NSVCD__SEEK_WORK;
  r->answer.status = NSVCD_ROUTE_LIMIT;
  result = nsvcd__plant(r);
  if (!result && r->trees[1].count > 0) result = nsvcd__seek(r);
  if (!result && r->way_count > 0) result = nsvcd__shorten(r);
  if (!result && r->way_count > 0) {
    nsvcd__thin_way(r);
    result = nsvcd__time_way(r);
  }
  if (result) return result;
  if (r->is_stopped && r->answer.status != NSVCD_ROUTE_FOUND)
    r->answer.status = NSVCD_ROUTE_STOPPED;
  r->answer.nodes = r->trees[0].count + r->trees[1].count;
  *answer = r->answer;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS

// ================================================================ plan: a motion that hits nothing

// ------------------------------------------------------------------------------------- plan/spline
// In: control points. Out: positions and derivatives; the weights of both.
//
// Control points -> positions and derivatives. All is linear in the control points, and the same
// for each joint: what the joints are at one moment is a sum of the points by weights (M + 2), and
// the mean of its square over the motion a quadratic form (M + 2, M + 2).

#ifndef NSVCD_NO_OPTIMIZER
// A derivative at u of a polynomial of degree five, times `scale`.
static double nsvcd__polynomial(const double *coefficients, double u, size_t derivative,
                                double scale) {
  double value = 0;
  double power = scale;
  for (size_t n = derivative; n < 6; n++, power *= u) {
    double factor = coefficients[n];
    for (size_t d = 0; d < derivative; d++) factor *= (double)(n - d);
    value += factor * power;
  }
  return value;
}

// The weights (M + 2) of the control points in the joints' derivative of the given order by t.
static void nsvcd__spline_weights(size_t via, double t, size_t derivative, double *weights) {
  // Polynomials of u in [0,1]: of the position, velocity and acceleration at its left end, then at
  // its right.
  static const double basis[6][6] = {{1, 0, 0, -10, 15, -6},       {0, 1, 0, -6, 8, -3},
                                     {0, 0, 0.5, -1.5, 1.5, -0.5}, {0, 0, 0, 10, -15, 6},
                                     {0, 0, 0, -4, 7, -3},         {0, 0, 0, 0.5, -1, 0.5}};
  const size_t last = via + 1;
  const double at = (t > 0 ? (t < 1 ? t : 1) : 0) * (double)last;
  const size_t left = (size_t)at < last ? (size_t)at : last - 1;
  const double u = at - (double)left;
  // derivatives by t, not by u
  double scale = 1;
  for (size_t k = 0; k < derivative; k++) scale *= (double)last;
  for (size_t k = 0; k <= last; k++) weights[k] = 0;
  for (size_t end = 0; end < 2; end++) {
    const double(*polynomials)[6] = basis + 3 * end;
    const size_t point = left + end;
    weights[point] += nsvcd__polynomial(polynomials[0], u, derivative, scale);
    // at rest
    if (point == 0 || point == last) continue;
    const double velocity = nsvcd__polynomial(polynomials[1], u, derivative, scale);
    const double acceleration = nsvcd__polynomial(polynomials[2], u, derivative, scale);
    weights[point + 1] += 0.5 * velocity + acceleration;
    weights[point - 1] += acceleration - 0.5 * velocity;
    weights[point] -= 2 * acceleration;
  }
}

NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out) {
  double weights[NSVCD_MAX_VIA_POINTS + 2];
  if (via_points > NSVCD_MAX_VIA_POINTS || derivative > 3) return;
  nsvcd__spline_weights(via_points, (double)t, derivative, weights);
  for (size_t j = 0; j < joints; j++) {
    double sum = 0;
    for (size_t k = 0; k < via_points + 2; k++)
      sum += weights[k] * (double)control[k * joints + j];
    out[j] = (float)sum;
  }
}

// Adds weight * mean over t of the derivative's square to the form (M + 2, M + 2). Five points of
// Gauss and Legendre per piece: exact, as the squares are of degree 8 at most.
static void nsvcd__add_mean_square(size_t via, size_t derivative, double weight,
                                   double *form) {
  static const double nodes[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                  0.953089922969332};
  static const double shares[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                   0.239314335249683, 0.118463442528095};
  const size_t count = via + 2;
  const double pieces = (double)(via + 1);
  double w[NSVCD_MAX_VIA_POINTS + 2];
  for (size_t piece = 0; piece < via + 1; piece++) {
    for (size_t n = 0; n < 5; n++) {
      const double t = ((double)piece + nodes[n]) / pieces;
      nsvcd__spline_weights(via, t, derivative, w);
      for (size_t i = 0; i < count; i++) {
        const double scaled = weight * shares[n] / pieces * w[i];
        for (size_t j = 0; j < count; j++) form[i * count + j] += scaled * w[j];
      }
    }
  }
}

// L L^T = a, lower; a, l: (n, n), and may be the same. Of a symmetric positive definite a; what
// rounding makes of it is kept positive.
static void nsvcd__cholesky(const double *a, size_t n, double *l) {
  for (size_t i = 0; i < n; i++) {
    const double least = 1e-9 * a[i * n + i];
    for (size_t j = 0; j < n; j++) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < (i < j ? i : j); k++) sum -= l[i * n + k] * l[j * n + k];
      if (j < i) l[i * n + j] = sum / l[j * n + j];
      if (j == i) l[i * n + i] = sqrt(sum > least ? sum : least);
      if (j > i) l[i * n + j] = 0;
    }
  }
}
// x = L^-1 x
static void nsvcd__solve_lower(const double *l, size_t n, double *x) {
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < i; k++) x[i] -= l[i * n + k] * x[k];
    x[i] /= l[i * n + i];
  }
}
// x = L^-T x
static void nsvcd__solve_upper(const double *l, size_t n, double *x) {
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; k++) x[i] -= l[k * n + i] * x[k];
    x[i] /= l[i * n + i];
  }
}
#endif  // NSVCD_NO_OPTIMIZER

// ------------------------------------------------------------------------------------ plan/problem
// In: a problem. Out: a planner: everything in the caller's workspace. The floor, top to bottom:
//
//   problem     everything in the caller's workspace
//   culling     which bodies may meet in which segments: a broad phase of whole bodies; poses along
//               a trajectory -> cost, and its derivative by the poses (wrenches)
//   cost        control points -> smoothness + limits + collision, and the derivative by the
//               control points
//   explore     MPPI: smooth random changes of a mean, weighted by exp(-cost / temperature)
//   refine      L-BFGS with bundled gradients, in the metric of the smoothness
//   plan        start and goal, several seeds, and the last check
//
// The planner asks as any program does, by the public functions. Of what is private to the floors
// above entry it uses nsvcd__settings_of, nsvcd__poses_are_valid and nsvcd__is_aligned, to refuse
// what a query would, and NSVCD__ROUNDING.
//
// A trajectory is looked at in *moments*, uniform in t, both ends among them; a *segment* lies
// between two of them. A *rollout* is one of MPPI's random trajectories; a *bundle* is the random
// changes over which L-BFGS takes the mean of a gradient. Letters of shapes: M via points, F
// joints, B bodies, P pairs.

#ifndef NSVCD_NO_OPTIMIZER
// The schedule of the search.
// cost: of joints out of their limits, per radian^2 or metre^2, mean over the moments
#define NSVCD__LIMIT_COST 1e5f
// cost: of a joint's range, kept free at both limits
#define NSVCD__LIMIT_MARGIN 0.005f
// collision: logits over which the cost grows from a slope of 0 to one of 1
#define NSVCD__SOFT_LOGITS 2
// collision: segments that one query asks about, where a first look may do
#define NSVCD__FIRST_LOOK_SEGMENTS 8
// gradient by differences: a joint's step, and what it grows by with the joint's value
#define NSVCD__JOINT_STEP 1e-3f
#define NSVCD__JOINT_STEP_SHARE 1e-6f
// explore: temperatures above the least cost at which a rollout weighs nothing
#define NSVCD__WEIGHTLESS 10
// explore: one in so many rollouts costs less than the least cost and two temperatures
#define NSVCD__ELITE 10
// explore: how far the mean goes towards that of the rollouts
#define NSVCD__MEAN_STEP 0.9f
// explore: it ends after so many iterations without a gain of 1 %, once the best is free
#define NSVCD__PATIENCE 3
// refine: steps of L-BFGS that are remembered; step lengths that are tried
#define NSVCD__HISTORY 8
#define NSVCD__STEPS 5
// plan: refinements more, with a wider margin, where the proof finds a hit
#define NSVCD__PUSHES 3
// plan: segments of the last check to one of the finest stage
#define NSVCD__CHECKS 16
// plan: looks, at least, at how far a piece of the spline strays
#define NSVCD__STRAY_LOOKS 16

// A body, in its own axes: its bounding sphere, and the box of its patches.
typedef struct nsvcd__shape {
  nsvcd__sphere sphere;
  nsvcd__box box;
} nsvcd__shape;

// A body at a moment.
typedef struct nsvcd__stance {
  nsvcd__transform pose;
  nsvcd__f3 centre;  // of its bounding sphere, from its origin, in the world's axes
  // of its turn to the next moment: the root of 1 - cos of half the angle
  float bend;
} nsvcd__stance;

// One way of looking at trajectories: while exploring, refining, or for the last check.
typedef struct nsvcd__stage {
  size_t via, moments;  // M; segments + 1
  // of the via points, M F
  size_t numbers;
  // of all control points
  size_t bytes;
  size_t iterations;
  // rollouts of an iteration, or gradients in a bundle
  size_t draws;
  // their standard deviation, radians or metres
  float noise;
  double *form;  // (M + 2, M + 2): smoothness
  // (M, M): Cholesky's, of the rows and columns of the via points
  double *factor;
  // of factor^-T times normal numbers: the greatest of a via point
  double deviation;
  // (moments, M + 2): of the control points, in the joints
  float *weights;
} nsvcd__stage;

typedef struct nsvcd__planner {
  const nsvcd_plan_problem *problem;
  // with the defaults filled in
  nsvcd_plan_options options;
  nsvcd__stage explore, refine, check;
  // workspace of queries
  void *query;
  size_t query_size;
  uint64_t random;  // the state of the random numbers
  // the first that a query or a pose gave
  nsvcd_result error;
  size_t trajectories, sweeps;
  // the one that is searched from
  size_t seed;
  // of all seeds, both stages
  size_t iterations;
  // by the progress callback
  int cancelled;

  // the trajectory that is looked at
  float *path;  // (moments, F)
  // (moments, B)
  nsvcd_pose *poses;
  // (moments, B)
  nsvcd__stance *stances;
  nsvcd__shape *shapes;  // (B)
  // (moments): may the pair at hand meet there?
  unsigned char *meets;
  // (P): pairs, in the order in which they are looked at
  uint32_t *queue;
  float *wrenches;  // (moments, B, 6)
  // (B): at a moment, with one joint moved
  nsvcd_pose *moved;
  float *jacobian;  // (B, 6, F)
  // (F): derivative by the joints of a moment
  float *by_path;

  // control points, (M + 2, F) each; the gradient's and those below have rows for via points only
  float *result;  // the best of all seeds
  // where the search is: MPPI's mean, L-BFGS's last point
  float *control;
  float *best;  // of this seed
  // the one that is costed
  float *trial;
  float *gradient;  // at `trial`, (M + 2, F)
  // means of offsets, or of gradients
  float *sum;
  // a change, or a direction
  float *offset;
  float *drawn;  // (draws, M, F): the random changes
  // (draws): of rollouts, then their weights
  float *costs;
  float *steps;  // (HISTORY, M, F): of L-BFGS,
  // (HISTORY, M, F): and what they changed in the gradient
  float *changes;
  // (M + 2): scratch
  double *vector;
} nsvcd__planner;

// What a trajectory costs.
typedef struct nsvcd__cost {
  float total, smoothness, collision;
  int collides;  // in what was looked at
  // that leaves its limits, or NSVCD_NONE
  size_t joint;
  // of the last check, which looks closer: the most suspicious moment, and who is suspected
  float logit, time;
  size_t pair;
  // a proof has found it, of what is inside too, or could not rule it out
  int proven;
} nsvcd__cost;

static const nsvcd__cost nsvcd__no_cost = {
    0, 0, 0, 0, NSVCD_NONE, -NSVCD_LOGIT_CERTAIN, 0, NSVCD_NONE, 0};

static int nsvcd__is_free(const nsvcd__cost *cost) {
  return !cost->collides && cost->joint == NSVCD_NONE;
}

// ---- memory

static size_t nsvcd__larger(size_t a, size_t b) {
  return a > b ? a : b;
}

// A weight: the default where 0 is given, 0 where it is negative.
static float nsvcd__weight_of(float given, float otherwise) {
  return given > 0 ? given : given < 0 ? 0 : otherwise;
}

// A stage of what the caller gave, and the defaults where that is 0. Returns 0 for what cannot be.
static int nsvcd__stage_of(const nsvcd_plan_stage *given, nsvcd_plan_stage defaults,
                           nsvcd__stage *stage) {
  const size_t segments = given->segments ? given->segments : defaults.segments;
  stage->via = given->via_points ? given->via_points : defaults.via_points;
  stage->moments = segments + 1;
  stage->iterations = given->iterations ? given->iterations : defaults.iterations;
  if (given->iterations == NSVCD_NONE) stage->iterations = 0;
  stage->draws = given->draws ? given->draws : defaults.draws;
  stage->noise = nsvcd__weight_of(given->noise, defaults.noise);
  if (stage->via > NSVCD_MAX_VIA_POINTS || segments > NSVCD_MAX_PLAN_SEGMENTS) return 0;
  return stage->draws <= 10000 && stage->iterations <= 100000;
}

// Is the problem one that can be stated?
static int nsvcd__problem_is_whole(const nsvcd_plan_problem *problem) {
  if (!problem || !problem->place) return 0;
  if (problem->joints < 1 || problem->joints > NSVCD_MAX_JOINTS) return 0;
  if (problem->body_count > 65536) return 0;
  if (!problem->low || !problem->high || !problem->start || !problem->goal) return 0;
  const int by_network = !problem->collision;
  if (problem->pair_count > 0 && (!problem->pairs || (by_network && !problem->bodies)))
    return 0;
  for (size_t k = 0; k < problem->pair_count; k++) {
    const size_t a = problem->pairs[k].a;
    const size_t b = problem->pairs[k].b;
    if (a >= problem->body_count || b >= problem->body_count || a == b) return 0;
    if (by_network && (!problem->bodies[a] || !problem->bodies[b])) return 0;
  }
  return 1;
}

// Fills in the defaults. Returns 0 for what cannot be.
static int nsvcd__planner_settings(const nsvcd_plan_problem *problem,
                                   const nsvcd_plan_options *options, nsvcd__planner *p) {
  // via points, segments, iterations, draws, noise
  static const nsvcd_plan_stage explore = {5, 24, 40, 100, 0.3f};
  static const nsvcd_plan_stage refine = {10, 22, 10, 10, 0.01f};
  nsvcd__settings unused;
  memset(p, 0, sizeof *p);
  if (!nsvcd__problem_is_whole(problem)) return 0;
  p->problem = problem;
  if (options) p->options = *options;
  nsvcd_plan_options *o = &p->options;
  const float floats[] = {o->velocity, o->acceleration, o->jerk,          o->collision,
                          o->duration, o->margin,       o->explore.noise, o->refine.noise};
  for (size_t k = 0; k < sizeof floats / sizeof *floats; k++) {
    if (!nsvcd__is_finite(floats[k])) return 0;
  }
  if (nsvcd__settings_of(&o->sweep.network, 1, 1, &unused)) return 0;
  if (!nsvcd__stage_of(&o->explore, explore, &p->explore)) return 0;
  if (!nsvcd__stage_of(&o->refine, refine, &p->refine)) return 0;
  if (o->refine.iterations == NSVCD_NONE) p->refine.via = p->explore.via;

  o->seeds = o->seeds ? o->seeds : 6;
  o->velocity = nsvcd__weight_of(o->velocity, 10);
  o->acceleration = nsvcd__weight_of(o->acceleration, 2);
  o->jerk = nsvcd__weight_of(o->jerk, 10);
  // something must be least
  if (!(o->velocity > 0 || o->acceleration > 0 || o->jerk > 0)) o->velocity = 1e-3f;
  o->collision = nsvcd__weight_of(o->collision, 20);
  o->duration = o->duration > 0 ? o->duration : 20;
  o->margin = nsvcd__weight_of(o->margin, 2);

  p->check = p->refine;
  const size_t finest = nsvcd__larger(p->explore.moments, p->refine.moments);
  const size_t most = 4 * NSVCD_MAX_PLAN_SEGMENTS;
  const size_t dense = NSVCD__CHECKS * (finest - 1);
  o->check = o->check ? o->check : dense < most ? dense : most;
  p->check.moments = o->check + 1;
  return o->check <= most && o->seeds <= 1000;
}

// The next rows of so many floats of a workspace: nsvcd__take.
static float *nsvcd__take_floats(char *base, uint64_t *used, size_t rows, size_t floats) {
  return (float *)nsvcd__take(base, used, rows, floats * sizeof(float));
}

// Lays the planner's memory out in base, or, where that is NULL, only measures. Returns the bytes;
// 0 if they are more than can be counted.
static size_t nsvcd__planner_memory(nsvcd__planner *p, char *base) {
  nsvcd__stage *const stages[3] = {&p->explore, &p->refine, &p->check};
  float **const points[7] = {&p->result,   &p->control, &p->best,  &p->trial,
                             &p->gradient, &p->sum,     &p->offset};
  const size_t f = p->problem->joints;
  const size_t bodies = p->problem->body_count;
  const size_t via = nsvcd__larger(p->explore.via, p->refine.via);
  const size_t draws = nsvcd__larger(p->explore.draws, p->refine.draws);
  const size_t searched = nsvcd__larger(p->explore.moments, p->refine.moments);
  const size_t moments = nsvcd__larger(p->check.moments, searched);
  const size_t placed = moments * bodies;
  const size_t point = (via + 2) * f;
  uint64_t used = 0;

  p->query_size = nsvcd_sweep_workspace_size(NULL);
  p->query = nsvcd__take(base, &used, 1, p->query_size);
  for (size_t k = 0; k < 3; k++) {
    nsvcd__stage *stage = stages[k];
    const size_t all = stage->via + 2;
    stage->numbers = stage->via * f;
    stage->bytes = all * f * sizeof(float);
    stage->form = (double *)nsvcd__take(base, &used, all, all * sizeof(double));
    stage->factor =
        (double *)nsvcd__take(base, &used, stage->via, stage->via * sizeof(double));
    stage->weights = nsvcd__take_floats(base, &used, stage->moments, all);
  }

  p->path = nsvcd__take_floats(base, &used, moments, f);
  p->poses = (nsvcd_pose *)nsvcd__take(base, &used, placed, sizeof(nsvcd_pose));
  p->stances = (nsvcd__stance *)nsvcd__take(base, &used, placed, sizeof(nsvcd__stance));
  p->shapes = (nsvcd__shape *)nsvcd__take(base, &used, bodies, sizeof(nsvcd__shape));
  p->meets = (unsigned char *)nsvcd__take(base, &used, moments, 1);
  p->queue = (uint32_t *)nsvcd__take(base, &used, p->problem->pair_count, sizeof(uint32_t));
  p->wrenches = nsvcd__take_floats(base, &used, placed, 6);
  p->moved = (nsvcd_pose *)nsvcd__take(base, &used, bodies, sizeof(nsvcd_pose));
  p->jacobian = nsvcd__take_floats(base, &used, bodies, 6 * f);
  p->by_path = nsvcd__take_floats(base, &used, 1, f);

  for (size_t k = 0; k < 7; k++) *points[k] = nsvcd__take_floats(base, &used, 1, point);
  p->drawn = nsvcd__take_floats(base, &used, draws, point);
  p->costs = nsvcd__take_floats(base, &used, 1, draws);
  p->steps = nsvcd__take_floats(base, &used, NSVCD__HISTORY, point);
  p->changes = nsvcd__take_floats(base, &used, NSVCD__HISTORY, point);
  p->vector = (double *)nsvcd__take(base, &used, 1, (via + 2) * sizeof(double));
  return used <= SIZE_MAX ? (size_t)used : 0;
}

// Fills in what a stage knows beforehand.
static void nsvcd__stage_init(const nsvcd_plan_options *o, nsvcd__stage *stage) {
  const double weights[3] = {(double)o->velocity, (double)o->acceleration, (double)o->jerk};
  const size_t via = stage->via;
  const size_t all = via + 2;
  double w[NSVCD_MAX_VIA_POINTS + 2];
  double rate = 1;
  for (size_t k = 0; k < all * all; k++) stage->form[k] = 0;
  for (size_t d = 1; d <= 3; d++) {
    rate /= (double)o->duration * (double)o->duration;
    nsvcd__add_mean_square(via, d, rate * weights[d - 1], stage->form);
  }
  for (size_t k = 0; k < via * via; k++)
    stage->factor[k] = stage->form[(k / via + 1) * all + k % via + 1];
  // in place: row i is read before it is written
  nsvcd__cholesky(stage->factor, via, stage->factor);

  stage->deviation = 0;
  // the variance of via point k is |L^-1 e_k|^2
  for (size_t k = 0; k < via; k++) {
    double square = 0;
    for (size_t i = 0; i < via; i++) w[i] = i == k;
    nsvcd__solve_lower(stage->factor, via, w);
    for (size_t i = 0; i < via; i++) square += w[i] * w[i];
    stage->deviation = fmax(sqrt(square), stage->deviation);
  }

  const size_t last = stage->moments - 1;
  for (size_t s = 0; s <= last; s++) {
    nsvcd__spline_weights(via, last > 0 ? (double)s / (double)last : 0, 0, w);
    for (size_t k = 0; k < all; k++) stage->weights[s * all + k] = (float)w[k];
  }
}
#endif  // NSVCD_NO_OPTIMIZER

// ------------------------------------------------------------------------------------ plan/culling
// A plan asks about each pair in each segment, and most of these are far from a collision. This
// rules them out for less than a query costs. It is a broad phase of whole bodies along a whole
// trajectory; that of search/search then goes through the patches of two bodies in one segment.
//
// In: the poses at the moments, and of each body its bounding sphere and the box of its patches.
// Out: for a pair, p->meets (moments): 0 where the query about the segment from there on would
// certify it free.
//
// Nothing is missed, for the box about the ends of a sphere's way is grown by all that the way may
// stray. The motion is the query's: as b sees it, a's origin goes straight, and a turns evenly
// about one axis by an angle c, no more than what a and b turn in the world. Two tests rule out:
//
//   a's sphere against b's box. Its centre turns about a's origin on an arc of radius `arm` or
//   less, and strays by no more than the arc's height, arm (1 - cos(c / 2)).
//
//   b's sphere against a's box. As a sees it, its centre v goes and turns at once. It strays by no
//   more than an eighth of its acceleration, c^2 |v| + 2 c |u|: u is its way in b's axes, and no
//   longer than its way in a's axes + c |v|. In all c (c |v| 3 / 8 + its way in a's axes / 4).

#ifndef NSVCD_NO_OPTIMIZER
// The shapes of all bodies.
static void nsvcd__find_shapes(nsvcd__planner *p) {
  for (size_t b = 0; p->problem->bodies && b < p->problem->body_count; b++) {
    const nsvcd_body *body = p->problem->bodies[b];
    nsvcd__shape shape = {{{0, 0, 0}, 0},
                          {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    float place[3];
    float r;
    if (!body) continue;
    const nsvcd_body_facts facts = nsvcd_body_describe(body);
    shape.sphere.centre = nsvcd__f3_load(facts.centre);
    shape.sphere.radius = facts.radius;
    for (uint32_t i = 0; nsvcd_body_patch(body, i, place, &r); i++) {
      const nsvcd__f3 about = nsvcd__f3_of(r, r, r);
      const nsvcd__f3 centre = nsvcd__f3_load(place);
      shape.box.low = nsvcd__f3_min(shape.box.low, nsvcd__f3_sub(centre, about));
      shape.box.high = nsvcd__f3_max(shape.box.high, nsvcd__f3_add(centre, about));
    }
    p->shapes[b] = shape;
  }
}

// The stances of all bodies at the moments of p->poses.
static void nsvcd__find_stances(nsvcd__planner *p, size_t moments) {
  const size_t bodies = p->problem->body_count;
  for (size_t b = 0; p->problem->bodies && b < bodies; b++) {
    if (!p->problem->bodies[b]) continue;
    for (size_t s = 0; s < moments; s++) {
      const nsvcd_pose *pose = &p->poses[s * bodies + b];
      const nsvcd_pose *next = s + 1 < moments ? pose + bodies : pose;
      const nsvcd__quat q = nsvcd__quat_load(pose->rotation);
      const float cosine = nsvcd__quat_dot(q, nsvcd__quat_load(next->rotation));
      const float square = 1.000001f - fabsf(cosine);
      nsvcd__stance *stance = &p->stances[s * bodies + b];
      stance->pose.rotation = nsvcd__mat3_of(q);
      stance->pose.position = nsvcd__f3_load(pose->position);
      stance->centre = nsvcd__mat3_apply(&stance->pose.rotation, p->shapes[b].sphere.centre);
      stance->bend = sqrtf(square > 0 ? square : 0);
    }
  }
}

// Does the bounding sphere of `body` stay away from the box of `other`, by the clearance, from
// moment s to s + stride? rests: `body` is the one that rests in the query, and `other` moves.
static inline int nsvcd__passes_by(const nsvcd__planner *p, size_t body, size_t other,
                                   int rests, size_t s, size_t stride) {
  const nsvcd__sphere *sphere = &p->shapes[body].sphere;
  const nsvcd__box *box = &p->shapes[other].box;
  const nsvcd__stance *now = p->stances + s * p->problem->body_count;
  // its centre as `other` sees it at both ends, and how far it is from that one's origin, in sum
  nsvcd__f3 seen[2];
  float distance = 0;
  for (size_t k = 0; k < 2; k++) {
    const nsvcd__stance *at = now + k * stride * p->problem->body_count;
    const nsvcd__transform *from = &at[other].pose;
    const nsvcd__f3 origin = nsvcd__f3_sub(at[body].pose.position, from->position);
    const nsvcd__f3 centre = nsvcd__f3_add(origin, at[body].centre);
    seen[k] = nsvcd__mat3_apply_transpose(&from->rotation, centre);
    distance += nsvcd__f3_length(centre);
  }

  // That root of the sum of two angles is no more than the sum of the roots, and c < 3.15 bend.
  const float bend = now[body].bend + now[other].bend;
  float strays = nsvcd__f3_length(sphere->centre) * bend * bend;
  if (rests) {
    const nsvcd__f3 way = nsvcd__f3_sub(seen[1], seen[0]);
    const float length = fabsf(way.x) + fabsf(way.y) + fabsf(way.z);
    strays = (3.75f * bend * distance + 0.8f * length) * bend;
  }
  const float apart = 1.00001f * sphere->radius + p->options.sweep.clearance;
  const float grown = apart + (float)stride * strays + NSVCD__ROUNDING * distance;
  const nsvcd__f3 about = nsvcd__f3_of(grown, grown, grown);
  const nsvcd__f3 low = nsvcd__f3_min(seen[0], seen[1]);
  const nsvcd__f3 high = nsvcd__f3_max(seen[0], seen[1]);
  return nsvcd__f3_exceeds(low, nsvcd__f3_add(box->high, about)) |
         nsvcd__f3_exceeds(nsvcd__f3_sub(box->low, about), high);
}

// Marks the segments (stride 1), or the moments (stride 0), in which a pair may meet: p->meets.
static void nsvcd__find_meetings(nsvcd__planner *p, const nsvcd_body_pair *pair,
                                 size_t moments, size_t stride) {
  for (size_t s = 0; s + stride < moments; s++) {
    p->meets[s] = !nsvcd__passes_by(p, pair->a, pair->b, 0, s, stride) &&
                  !nsvcd__passes_by(p, pair->b, pair->a, 1, s, stride);
  }
}

// ---- collision

// The pose of a as b sees it.
static nsvcd_pose nsvcd__relative_pose(const nsvcd_pose *a, const nsvcd_pose *b) {
  const nsvcd__quat turned = nsvcd__quat_load(b->rotation);
  const nsvcd__mat3 axes = nsvcd__mat3_of(turned);
  const nsvcd__f3 from = nsvcd__f3_load(b->position);
  const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__f3_load(a->position), from);
  const nsvcd__quat to_b = nsvcd__quat_inverse(turned);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__mat3_apply_transpose(&axes, offset), out.position);
  nsvcd__quat_store(nsvcd__quat_mul(to_b, nsvcd__quat_load(a->rotation)), out.rotation);
  return out;
}

// What a logit costs: nothing below -margin, and above it its excess, but for a soft beginning.
// *slope: the derivative by the logit.
static float nsvcd__cost_of_logit(float logit, float margin, float *slope) {
  const float x = logit + margin;
  const float soft = NSVCD__SOFT_LOGITS;
  *slope = x <= 0 ? 0 : x < soft ? x / soft : 1;
  return x <= 0 ? 0 : x < soft ? 0.5f * x * x / soft : x - 0.5f * soft;
}

// Adds to the wrenches (B, 6) one on a that b sees, (6) in its axes, times `scale`, and what that
// does to b. A wrench is the derivative by a pose: by the position, and by a small rotation about
// it. poses: (B).
static void nsvcd__add_wrench(const nsvcd_body_pair *pair, const nsvcd_pose *poses,
                              float scale, const float *seen, float *wrenches) {
  const nsvcd__mat3 axes = nsvcd__mat3_of(nsvcd__quat_load(poses[pair->b].rotation));
  const nsvcd__f3 force = nsvcd__mat3_apply(&axes, nsvcd__f3_load(seen));
  const nsvcd__f3 torque = nsvcd__mat3_apply(&axes, nsvcd__f3_load(seen + 3));
  const nsvcd__f3 from = nsvcd__f3_load(poses[pair->b].position);
  const nsvcd__f3 arm = nsvcd__f3_sub(nsvcd__f3_load(poses[pair->a].position), from);
  const nsvcd__f3 back = nsvcd__f3_add(torque, nsvcd__f3_cross(arm, force));
  for (size_t k = 0; k < 4; k++) {
    const float by = k < 2 ? scale : -scale;
    float *row = wrenches + 6 * (k < 2 ? pair->a : pair->b) + 3 * (k % 2);
    const nsvcd__f3 moment = k < 2 ? torque : back;
    nsvcd__f3_store(nsvcd__f3_fma(by, k % 2 ? moment : force, nsvcd__f3_load(row)), row);
  }
}

// A logit of any answer: what is undecided counts as a hit.
static float nsvcd__logit_of(const nsvcd_answer *answer) {
  if (answer->verdict != NSVCD_UNDECIDED && answer->opinion.asked)
    return answer->opinion.logit;
  return answer->verdict == NSVCD_FREE ? -NSVCD_LOGIT_CERTAIN : NSVCD_LOGIT_CERTAIN;
}

// The answer about pair k from moment `first` on, over so many segments: by the network, or, at the
// end, by the method of the options. gradient: (segments + 1, 6), or NULL.
static nsvcd_answer nsvcd__ask(nsvcd__planner *p, uint32_t k, size_t first, size_t segments,
                               int at_end, float *gradient) {
  const nsvcd_body_pair *pair = &p->problem->pairs[k];
  nsvcd_pose motion[NSVCD__FIRST_LOOK_SEGMENTS + 1];
  for (size_t n = 0; n <= segments; n++) {
    const nsvcd_pose *row = p->poses + (first + n) * p->problem->body_count;
    motion[n] = nsvcd__relative_pose(&row[pair->a], &row[pair->b]);
  }

  const nsvcd_mover a = {p->problem->bodies[pair->a], motion, segments + 1, NULL, 0};
  const nsvcd_mover b = {p->problem->bodies[pair->b], NULL, 0, NULL, 0};
  nsvcd_question question = p->options.sweep;
  question.a = a;
  question.b = b;
  question.ask = NSVCD_ASK_HIT;
  question.to = question.to_time = 0;
  question.manifold = 0;
  if (!at_end) {
    question.method = NSVCD_METHOD_NETWORK;
    question.clearance = 0;
    question.skin = 0;
  }

  nsvcd_answer answer;
  nsvcd_result error;
  memset(&answer, 0, sizeof answer);
  // of an error
  answer.verdict = NSVCD_FREE;
  if (gradient)
    error = nsvcd_sweep_gradient(&question, p->query, p->query_size, &answer, gradient, NULL);
  else
    error = nsvcd_sweep(&question, p->query, p->query_size, &answer);
  if (error) p->error = error;
  p->sweeps++;
  return answer;
}

// How a trajectory, p->poses, is asked about.
typedef struct nsvcd__asking {
  size_t moments;
  // 1: segments are asked about, 0: moments
  size_t stride;
  // it is the last check
  int at_end;
  // a sum beyond it is not finished
  float limit;
  // (moments, B, 6), added to, or NULL
  float *wrenches;
} nsvcd__asking;

// Adds what pair k costs from moment s to s + stride.
static void nsvcd__add_segment(nsvcd__planner *p, uint32_t k, size_t s,
                               const nsvcd__asking *how, nsvcd__cost *cost) {
  const nsvcd_body_pair *pair = &p->problem->pairs[k];
  float gradient[2 * 6];
  float slope;
  float *wanted = how->wrenches ? gradient : NULL;
  const nsvcd_answer answer = nsvcd__ask(p, k, s, how->stride, how->at_end, wanted);
  const float logit = nsvcd__logit_of(&answer);
  const int collides = answer.verdict != NSVCD_FREE;
  if (logit > cost->logit) {
    const int by_proof = answer.by == NSVCD_BY_PROOF;
    const float t = by_proof ? answer.nearest.time : answer.opinion.time;
    const float at = (float)s + (float)how->stride * t;
    cost->logit = logit;
    cost->pair = k;
    // only a proof takes work
    cost->proven = collides && answer.work > 0;
    cost->time = how->moments > 1 ? at / (float)(how->moments - 1) : 0;
  }
  cost->collides |= collides;
  cost->collision += nsvcd__cost_of_logit(logit, p->options.margin, &slope);
  for (size_t i = 0; wanted && slope > 0 && i <= how->stride; i++) {
    const size_t row = (s + i) * p->problem->body_count;
    nsvcd__add_wrench(pair, p->poses + row, slope, gradient + 6 * i, how->wrenches + 6 * row);
  }
}

// Adds what pair k costs along the trajectory.
static void nsvcd__add_pair(nsvcd__planner *p, uint32_t k, const nsvcd__asking *how,
                            nsvcd__cost *cost) {
  const int looks_ahead = how->stride && !how->at_end;
  const size_t end = how->moments - how->stride;
  // up to here segments have had a first look
  size_t seen = 0;
  nsvcd__find_meetings(p, &p->problem->pairs[k], how->moments, how->stride);
  for (size_t s = 0; s < end && cost->collision <= how->limit && !p->error; s++) {
    if (!p->meets[s]) continue;
    if (looks_ahead && s >= seen) {
      // The segments that follow in which the pair may meet, at once: if they are far from a
      // collision, that is all.
      size_t run = 1;
      while (run < NSVCD__FIRST_LOOK_SEGMENTS && s + run < end && p->meets[s + run]) run++;
      seen = s + run;
      if (run > 1) {
        const nsvcd_answer answer = nsvcd__ask(p, k, s, run, 0, NULL);
        if (nsvcd__logit_of(&answer) <= -p->options.margin) {
          s += run - 1;
          continue;
        }
      }
    }
    nsvcd__add_segment(p, k, s, how, cost);
  }
}

// Adds the collision cost of p->poses, by the problem's own function or by the network, up to the
// first sum above `limit`. wrenches: (moments, B, 6), added to, or NULL. at_end: of the last check.
static void nsvcd__add_collision(nsvcd__planner *p, size_t moments, float limit,
                                 float *wrenches, int at_end, nsvcd__cost *cost) {
  const nsvcd_plan_problem *problem = p->problem;
  const size_t stride = !p->options.discrete && moments > 1;
  const nsvcd__asking how = {moments, stride, at_end, limit, wrenches};
  if (problem->collision) {
    cost->collision =
        problem->collision(problem->user, p->poses, moments, limit, &cost->collides, wrenches);
    cost->logit = cost->collision;
    return;
  }
  nsvcd__find_stances(p, moments);
  for (size_t n = 0; n < problem->pair_count && cost->collision <= limit; n++) {
    const uint32_t k = p->queue[n];
    const float before = cost->collision;
    nsvcd__add_pair(p, k, &how, cost);
    // what costs comes earlier next time, so that bad trajectories end early
    if (n > 0 && cost->collision > before) {
      p->queue[n] = p->queue[n - 1];
      p->queue[n - 1] = k;
    }
  }
}
#endif  // NSVCD_NO_OPTIMIZER

// --------------------------------------------------------------------------------------- plan/cost
// In: control points. Out: smoothness + limits + collision, and the derivative by the control
// points.

#ifndef NSVCD_NO_OPTIMIZER
// The derivative by the joints of one moment, p->by_path (F), from the wrenches (B, 6) there, by
// differences of `place`. poses: (B), at these joints.
static void nsvcd__by_differences(nsvcd__planner *p, const float *joints,
                                  const nsvcd_pose *poses, const float *wrenches) {
  const nsvcd_plan_problem *problem = p->problem;
  float moved[NSVCD_MAX_JOINTS];
  memcpy(moved, joints, problem->joints * sizeof *moved);
  for (size_t j = 0; j < problem->joints; j++) {
    moved[j] = joints[j] + (NSVCD__JOINT_STEP + NSVCD__JOINT_STEP_SHARE * fabsf(joints[j]));
    const float step = moved[j] - joints[j];  // as rounded
    problem->place(problem->user, moved, p->moved);
    moved[j] = joints[j];
    p->by_path[j] = 0;
    for (size_t b = 0; b < problem->body_count; b++) {
      const nsvcd__quat q = nsvcd__quat_load(poses[b].rotation);
      const nsvcd__quat r = nsvcd__quat_load(p->moved[b].rotation);
      const float twice = nsvcd__quat_dot(q, r) < 0 ? -2.0f : 2.0f;
      const nsvcd__f3 turn = nsvcd__f3_scale(nsvcd__quat_turn(q, r), twice / step);
      const nsvcd__f3 from = nsvcd__f3_load(poses[b].position);
      const nsvcd__f3 way = nsvcd__f3_sub(nsvcd__f3_load(p->moved[b].position), from);
      p->by_path[j] += nsvcd__f3_dot(nsvcd__f3_row(wrenches, 2 * b), way) / step;
      p->by_path[j] += nsvcd__f3_dot(nsvcd__f3_row(wrenches, 2 * b + 1), turn);
    }
  }
}

// The poses of all bodies (moments, B), their quaternions made of unit length, from the joints
// (moments, F).
static void nsvcd__place(nsvcd__planner *p, const float *joints, size_t moments,
                         nsvcd_pose *poses) {
  const nsvcd_plan_problem *problem = p->problem;
  const size_t bodies = problem->body_count;
  const size_t count = moments * bodies;
  for (size_t s = 0; s < moments; s++)
    problem->place(problem->user, joints + s * problem->joints, poses + s * bodies);
  if (count > 0 && !nsvcd__poses_are_valid(poses, count)) {
    p->error = NSVCD_ERROR_POSE;
    return;
  }
  for (size_t k = 0; k < count; k++) {
    const nsvcd__quat unit = nsvcd__quat_unit(nsvcd__quat_load(poses[k].rotation));
    nsvcd__quat_store(unit, poses[k].rotation);
  }
}

// The smoothness of a trajectory; gradient: (M + 2, F), written, or NULL.
static float nsvcd__smoothness(const nsvcd__planner *p, const nsvcd__stage *stage,
                               const float *control, float *gradient) {
  const size_t f = p->problem->joints;
  const size_t all = stage->via + 2;
  double smoothness = 0;
  for (size_t j = 0; j < f; j++) {
    for (size_t i = 0; i < all; i++) {
      double sum = 0;
      for (size_t k = 0; k < all; k++)
        sum += stage->form[i * all + k] * (double)control[k * f + j];
      smoothness += sum * (double)control[i * f + j];
      if (gradient) gradient[i * f + j] = (float)(2 * sum);
    }
  }
  return (float)smoothness;
}

static int nsvcd__leaves_limits(const nsvcd_plan_problem *problem, size_t joint, float value) {
  const float rounding = 1e-5f + 1e-6f * fabsf(value);
  return value < problem->low[joint] - rounding || value > problem->high[joint] + rounding;
}

// Fills p->path with the joints at the moments of a trajectory, and adds what it costs that they
// leave their limits, or come nearer to these than the margin. gradient: (M + 2, F), added to, or
// NULL.
static void nsvcd__add_limits(nsvcd__planner *p, const nsvcd__stage *stage,
                              const float *control, float *gradient, nsvcd__cost *cost) {
  const nsvcd_plan_problem *problem = p->problem;
  const size_t f = problem->joints;
  const size_t all = stage->via + 2;
  const float share = NSVCD__LIMIT_COST / (float)stage->moments;
  // via points too: moments may be few, and miss one
  for (size_t k = f; k < f + stage->numbers && cost->joint == NSVCD_NONE; k++) {
    if (nsvcd__leaves_limits(problem, k % f, control[k])) cost->joint = k % f;
  }
  for (size_t s = 0; s < stage->moments; s++) {
    const float *w = stage->weights + s * all;
    for (size_t j = 0; j < f; j++) {
      float value = 0;
      for (size_t k = 0; k < all; k++) value += w[k] * control[k * f + j];
      p->path[s * f + j] = value;

      const float low = problem->low[j];
      const float high = problem->high[j];
      const float inner = NSVCD__LIMIT_MARGIN * (high - low);
      float out = value > high - inner ? value - high + inner : 0;
      if (value < low + inner) out = value - low - inner;
      cost->total += share * out * out;
      if (nsvcd__leaves_limits(problem, j, value)) cost->joint = j;
      for (size_t k = 0; gradient && k < all; k++)
        gradient[k * f + j] += 2 * share * out * w[k];
    }
  }
}

// Adds to the gradient by the control points what p->wrenches say.
static void nsvcd__add_wrenches(nsvcd__planner *p, const nsvcd__stage *stage,
                                float *gradient) {
  const nsvcd_plan_problem *problem = p->problem;
  const size_t f = problem->joints;
  const size_t numbers = 6 * problem->body_count;
  const size_t all = stage->via + 2;
  for (size_t s = 0; s < stage->moments; s++) {
    const float *joints = p->path + s * f;
    const float *wrenches = p->wrenches + s * numbers;
    int has_any = 0;
    for (size_t k = 0; k < numbers && !has_any; k++)
      has_any = wrenches[k] < 0 || wrenches[k] > 0;
    if (!has_any) continue;
    if (problem->jacobian) {
      problem->jacobian(problem->user, joints, p->jacobian);
      for (size_t j = 0; j < f; j++) {
        p->by_path[j] = 0;
        for (size_t i = 0; i < numbers; i++)
          p->by_path[j] += wrenches[i] * p->jacobian[i * f + j];
      }
    } else {
      nsvcd__by_differences(p, joints, p->poses + s * problem->body_count, wrenches);
    }
    for (size_t k = 0; k < all; k++) {
      const float weight = p->options.collision * stage->weights[s * all + k];
      for (size_t j = 0; j < f; j++) gradient[k * f + j] += weight * p->by_path[j];
    }
  }
}

// What the trajectory costs, up to `limit`: a sum beyond it is not finished. gradient: (M + 2, F),
// written, or NULL. at_end: by the last check.
static nsvcd__cost nsvcd__cost_of(nsvcd__planner *p, const nsvcd__stage *stage,
                                  const float *control, float limit, float *gradient,
                                  int at_end) {
  const size_t numbers = 6 * stage->moments * p->problem->body_count;
  const float weight = p->options.collision;
  float *wrenches = gradient ? p->wrenches : NULL;
  nsvcd__cost cost = nsvcd__no_cost;
  p->trajectories++;
  cost.smoothness = nsvcd__smoothness(p, stage, control, gradient);
  cost.total = cost.smoothness;
  nsvcd__add_limits(p, stage, control, gradient, &cost);
  if (cost.total > limit || p->error) return cost;
  nsvcd__place(p, p->path, stage->moments, p->poses);
  if (p->error) return cost;

  const float left = weight > 0 ? (limit - cost.total) / weight : INFINITY;
  if (wrenches) memset(wrenches, 0, numbers * sizeof *wrenches);
  // begins
  NSVCD__TALLY(collision, 0);
  nsvcd__add_collision(p, stage->moments, left, wrenches, at_end, &cost);
  // ends
  NSVCD__TALLY(collision, 1);
  cost.total += weight * cost.collision;
  if (gradient) nsvcd__add_wrenches(p, stage, gradient);
  if (!nsvcd__is_finite(cost.total)) p->error = NSVCD_ERROR_NUMBER;
  return cost;
}
#endif  // NSVCD_NO_OPTIMIZER

// ------------------------------------------------------------------------------------ plan/explore
// In: a mean of control points. Out: a better one: smooth random changes, weighted by exp(-cost /
// temperature).

#ifndef NSVCD_NO_OPTIMIZER
// A normal number: Box and Muller.
static double nsvcd__normal(nsvcd__planner *p) {
  const double size = nsvcd__random(&p->random);
  return sqrt(-2 * log(size)) * cos(6.283185307179586 * nsvcd__random(&p->random));
}

// A smooth random change of the via points, (M, F), zero at the ends: its inverse covariance is the
// form of the smoothness, scaled so that the greatest deviation of a joint is deviations (F).
static void nsvcd__smooth_noise(nsvcd__planner *p, const nsvcd__stage *stage,
                                const float *deviations, float *out) {
  const size_t f = p->problem->joints;
  const size_t via = stage->via;
  for (size_t j = 0; j < f; j++) {
    for (size_t k = 0; k < via; k++) p->vector[k] = nsvcd__normal(p);
    nsvcd__solve_upper(stage->factor, via, p->vector);
    const double scale = (double)deviations[j] / stage->deviation;
    for (size_t k = 0; k < via; k++) out[k * f + j] = (float)(scale * p->vector[k]);
  }
}

// control + scale * offset (M, F), with via points taken into the limits: out (M + 2, F).
static void nsvcd__change(const nsvcd__planner *p, const nsvcd__stage *stage,
                          const float *control, const float *offset, float scale, float *out) {
  const size_t f = p->problem->joints;
  memcpy(out, control, stage->bytes);
  for (size_t k = 0; k < stage->numbers; k++) {
    const float x = control[f + k] + scale * offset[k];
    const float low = p->problem->low[k % f];
    const float high = p->problem->high[k % f];
    // high where x is not a number
    out[f + k] = x < low ? low : x < high ? x : high;
  }
}

// Counts an iteration and tells the caller how far it has come, which may cancel the search.
static void nsvcd__report(nsvcd__planner *p, size_t iteration, const nsvcd__stage *stage,
                          const nsvcd__cost *best) {
  const int refining = stage == &p->refine;
  const nsvcd_plan_progress progress = {p->seed,  iteration,   stage->iterations,
                                        refining, best->total, best->collision,
                                        p->best,  stage->via};
  p->iterations++;
  if (p->problem->progress) p->cancelled = p->problem->progress(p->problem->user, &progress);
}

// The deviations (F) of the first rollouts: no more than a quarter of a joint's range.
static void nsvcd__first_deviations(const nsvcd__planner *p, float *deviations) {
  for (size_t j = 0; j < p->problem->joints; j++) {
    const float quarter = 0.25f * (p->problem->high[j] - p->problem->low[j]);
    deviations[j] = p->explore.noise < quarter ? p->explore.noise : quarter;
  }
}

// Where MPPI is.
typedef struct nsvcd__exploring {
  // of the rollouts, joint by joint
  float deviations[NSVCD_MAX_JOINTS];
  // what they were
  float first[NSVCD_MAX_JOINTS];
  float temperature;  // 0 at first
  // cost, of the last rollouts
  float least;
  nsvcd__cost best;  // of all
} nsvcd__exploring;

// Draws rollouts about p->control and finds what they cost; the best of all goes to p->best. The
// first has no offset (M, F), the second is the best so far, which competes, the others are noise.
static void nsvcd__roll_out(nsvcd__planner *p, nsvcd__exploring *at) {
  const nsvcd__stage *stage = &p->explore;
  const size_t f = p->problem->joints;
  at->least = INFINITY;
  for (size_t n = 0; n < stage->draws; n++) {
    float *offset = p->drawn + n * stage->numbers;
    if (n > 0) nsvcd__smooth_noise(p, stage, at->deviations, offset);
    for (size_t k = 0; n < 2 && k < stage->numbers; k++)
      offset[k] = n > 0 ? p->best[f + k] - p->control[f + k] : 0;
    nsvcd__change(p, stage, p->control, offset, 1, p->trial);
    for (size_t k = 0; k < stage->numbers; k++)
      offset[k] = p->trial[f + k] - p->control[f + k];

    // The cost of one that weighs nothing need not be known exactly.
    float limit = INFINITY;
    if (at->temperature > 0) limit = at->least + NSVCD__WEIGHTLESS * at->temperature;
    const nsvcd__cost cost = nsvcd__cost_of(p, stage, p->trial, limit, NULL, 0);
    p->costs[n] = cost.total;
    if (cost.total < at->least) at->least = cost.total;
    if (cost.total >= at->best.total || cost.total > limit) continue;
    at->best = cost;
    memcpy(p->best, p->trial, stage->bytes);
  }
}

// Turns p->costs into weights, whose sum is 1, p->sum into the mean of the offsets, and takes the
// deviations towards those of the good rollouts about their mean, slowly.
static void nsvcd__weigh_rollouts(nsvcd__planner *p, nsvcd__exploring *at) {
  const nsvcd__stage *stage = &p->explore;
  const size_t f = p->problem->joints;
  const size_t draws = stage->draws;
  const size_t rank = draws / NSVCD__ELITE;
  // the cost of that rank
  float elite = 0;
  float total = 0;
  for (size_t i = 0; i < draws; i++) {
    size_t below = 0;
    size_t not_above = 0;
    for (size_t n = 0; n < draws; n++) {
      below += p->costs[n] < p->costs[i];
      not_above += p->costs[n] <= p->costs[i];
    }
    if (below <= rank && rank < not_above) elite = p->costs[i];
  }
  at->temperature = 0.5f * (elite - at->least) + 1e-6f * (1 + at->least);
  for (size_t n = 0; n < draws; n++) {
    p->costs[n] = expf((at->least - p->costs[n]) / at->temperature);
    total += p->costs[n];
  }
  memset(p->sum, 0, stage->numbers * sizeof *p->sum);
  for (size_t n = 0; n < draws; n++) {
    const float weight = p->costs[n] / total;
    p->costs[n] = weight > 1e-9f ? weight : 0;
    for (size_t k = 0; weight > 1e-9f && k < stage->numbers; k++)
      p->sum[k] += weight * p->drawn[n * stage->numbers + k];
  }

  for (size_t j = 0; j < f; j++) {
    const float now = at->deviations[j];
    const float least = 1e-3f * at->first[j] * at->first[j];
    float square = 0;
    for (size_t n = 0; n < draws; n++) {
      for (size_t k = j; p->costs[n] > 0 && k < stage->numbers; k += f) {
        const float d = p->drawn[n * stage->numbers + k] - p->sum[k];
        square += p->costs[n] * d * d / (float)stage->via;
      }
    }
    const float variance = 0.9f * now * now + 0.1f * 2 * square;
    at->deviations[j] = sqrtf(variance > least ? variance : least);
  }
}

// MPPI from p->control, the mean, on; leaves the best trajectory in p->best.
static void nsvcd__explore(nsvcd__planner *p) {
  const nsvcd__stage *stage = &p->explore;
  nsvcd__exploring at;
  memset(&at, 0, sizeof at);
  at.best = nsvcd__cost_of(p, stage, p->control, INFINITY, NULL, 0);
  memcpy(p->best, p->control, stage->bytes);
  nsvcd__first_deviations(p, at.first);
  memcpy(at.deviations, at.first, sizeof at.deviations);
  float before = at.best.total;
  size_t waited = 0;
  for (size_t i = 0; i < stage->iterations && waited < NSVCD__PATIENCE; i++) {
    if (p->cancelled || p->error) break;
    nsvcd__roll_out(p, &at);
    if (p->error) break;
    nsvcd__weigh_rollouts(p, &at);
    nsvcd__change(p, stage, p->control, p->sum, NSVCD__MEAN_STEP, p->trial);
    memcpy(p->control, p->trial, stage->bytes);

    const int better = at.best.total < 0.99f * before;
    waited = !nsvcd__is_free(&at.best) || better ? 0 : waited + 1;
    before = better ? at.best.total : before;
    nsvcd__report(p, i, stage, &at.best);
  }
}
#endif  // NSVCD_NO_OPTIMIZER

// ------------------------------------------------------------------------------------- plan/refine
// In: control points. Out: better ones: L-BFGS with bundled gradients, in the metric of the
// smoothness.

#ifndef NSVCD_NO_OPTIMIZER
static double nsvcd__dot(const float *a, const float *b, size_t count) {
  double sum = 0;
  for (size_t k = 0; k < count; k++) sum += (double)a[k] * (double)b[k];
  return sum;
}

// The mean of the gradients at control + each of the bundle's offsets, p->drawn: p->sum (M, F).
static void nsvcd__bundled_gradient(nsvcd__planner *p, const nsvcd__stage *stage,
                                    const float *control) {
  const size_t f = p->problem->joints;
  memset(p->sum, 0, stage->numbers * sizeof *p->sum);
  for (size_t n = 0; n < stage->draws && !p->error; n++) {
    nsvcd__change(p, stage, control, p->drawn + n * stage->numbers, 1, p->trial);
    nsvcd__cost_of(p, stage, p->trial, INFINITY, p->gradient, 0);
    for (size_t k = 0; k < stage->numbers; k++)
      p->sum[k] += p->gradient[f + k] / (float)stage->draws;
  }
}

// The n-th step, or change of the gradient along it, of which the last HISTORY are kept.
static float *nsvcd__remembered(float *rows, size_t n, const nsvcd__stage *stage) {
  return rows + n % NSVCD__HISTORY * stage->numbers;
}

// L-BFGS's direction for the gradient in p->sum: p->offset (M, F). It starts from half the inverse
// of the smoothness' form, which is exact where nothing collides, and knows of the `kept` steps
// before step `next` what each changed in the gradient.
static void nsvcd__direction(nsvcd__planner *p, const nsvcd__stage *stage, size_t kept,
                             size_t next) {
  const size_t numbers = stage->numbers;
  const size_t f = p->problem->joints;
  double alpha[NSVCD__HISTORY];
  float *d = p->offset;
  for (size_t k = 0; k < numbers; k++) d[k] = -p->sum[k];
  for (size_t n = 1; n <= kept; n++) {
    const float *s = nsvcd__remembered(p->steps, next - n, stage);
    const float *y = nsvcd__remembered(p->changes, next - n, stage);
    alpha[n - 1] = nsvcd__dot(s, d, numbers) / nsvcd__dot(s, y, numbers);
    for (size_t k = 0; k < numbers; k++) d[k] -= (float)alpha[n - 1] * y[k];
  }
  for (size_t j = 0; j < f; j++) {
    for (size_t k = 0; k < stage->via; k++) p->vector[k] = (double)d[k * f + j];
    nsvcd__solve_lower(stage->factor, stage->via, p->vector);
    nsvcd__solve_upper(stage->factor, stage->via, p->vector);
    for (size_t k = 0; k < stage->via; k++) d[k * f + j] = 0.5f * (float)p->vector[k];
  }
  for (size_t n = kept; n > 0; n--) {
    const float *s = nsvcd__remembered(p->steps, next - n, stage);
    const float *y = nsvcd__remembered(p->changes, next - n, stage);
    const double beta = nsvcd__dot(y, d, numbers) / nsvcd__dot(s, y, numbers);
    for (size_t k = 0; k < numbers; k++) d[k] += (float)(alpha[n - 1] - beta) * s[k];
  }
}

// L-BFGS from p->best on, which it improves. Ends early where not even the first direction leads
// down.
static void nsvcd__refine(nsvcd__planner *p) {
  static const float lengths[NSVCD__STEPS] = {1, 0.5f, 0.2f, 0.05f, 0.01f};
  const nsvcd__stage *stage = &p->refine;
  const size_t f = p->problem->joints;
  const size_t numbers = stage->numbers;
  float deviations[NSVCD_MAX_JOINTS];
  // steps, before step `next`
  size_t kept = 0;
  size_t next = 0;
  int stuck = 0;
  nsvcd__cost best = nsvcd__cost_of(p, stage, p->best, INFINITY, NULL, 0);

  // The same offsets at each iteration: the mean is then a function, and its gradients differ by
  // where they are taken.
  for (size_t j = 0; j < f; j++) deviations[j] = stage->noise;
  for (size_t n = 0; n < stage->draws; n++)
    nsvcd__smooth_noise(p, stage, deviations, p->drawn + n * numbers);

  for (size_t i = 0; i < stage->iterations && !stuck && !p->cancelled && !p->error; i++) {
    const float before = best.total;
    memcpy(p->control, p->best, stage->bytes);
    nsvcd__bundled_gradient(p, stage, p->control);
    if (kept > 0) {
      // The change along the last step is known as minus the gradient before it. The step is
      // forgotten if the gradient does not grow along it.
      const float *step = nsvcd__remembered(p->steps, next - 1, stage);
      float *change = nsvcd__remembered(p->changes, next - 1, stage);
      for (size_t k = 0; k < numbers; k++) change[k] += p->sum[k];
      const int grows = nsvcd__dot(step, change, numbers) > 1e-12;
      next -= !grows;
      kept -= !grows;
    }
    nsvcd__direction(p, stage, kept, next);
    for (size_t n = 0; n < NSVCD__STEPS && !p->error; n++) {
      nsvcd__change(p, stage, p->control, p->offset, lengths[n], p->trial);
      const nsvcd__cost cost = nsvcd__cost_of(p, stage, p->trial, best.total, NULL, 0);
      if (!(cost.total < best.total)) continue;
      best = cost;
      memcpy(p->best, p->trial, stage->bytes);
    }
    if (best.total < before) {
      float *step = nsvcd__remembered(p->steps, next, stage);
      float *change = nsvcd__remembered(p->changes, next, stage);
      for (size_t k = 0; k < numbers; k++) {
        step[k] = p->best[f + k] - p->control[f + k];
        change[k] = -p->sum[k];
      }
      next++;
      kept += kept < NSVCD__HISTORY;
    } else {
      stuck = kept == 0;
      kept = 0;
    }
    nsvcd__report(p, i, stage, &best);
  }
}
#endif  // NSVCD_NO_OPTIMIZER

// --------------------------------------------------------------------------------------- plan/plan
// In: a planning problem. Out: control points of a motion that is checked to hit nothing, or the
// best there is.

#ifndef NSVCD_NO_OPTIMIZER
// The smoothest control points from start to goal, (M + 2, F): where the form's derivative is zero.
static void nsvcd__smoothest(nsvcd__planner *p, const nsvcd__stage *stage, float *control) {
  const size_t f = p->problem->joints;
  const size_t via = stage->via;
  const size_t all = via + 2;
  for (size_t j = 0; j < f; j++) {
    const double start = (double)p->problem->start[j];
    const double goal = (double)p->problem->goal[j];
    for (size_t k = 0; k < via; k++) {
      const double *row = stage->form + (k + 1) * all;
      p->vector[k] = -row[0] * start - row[all - 1] * goal;
    }
    nsvcd__solve_lower(stage->factor, via, p->vector);
    nsvcd__solve_upper(stage->factor, via, p->vector);
    for (size_t k = 0; k < via; k++) control[(k + 1) * f + j] = (float)p->vector[k];
  }
  memcpy(control, p->problem->start, f * sizeof *control);
  memcpy(control + (via + 1) * f, p->problem->goal, f * sizeof *control);
}

// Are the joints within the limits, and free of collision? Fills in the answer's facts if not.
static int nsvcd__is_good(nsvcd__planner *p, const float *joints, nsvcd_plan_answer *answer) {
  const nsvcd_plan_problem *problem = p->problem;
  nsvcd__cost cost = nsvcd__no_cost;
  answer->logit = 0;
  answer->pair = NSVCD_NONE;
  for (size_t j = 0; j < problem->joints; j++) {
    if (joints[j] < problem->low[j] || joints[j] > problem->high[j]) answer->joint = j;
  }
  if (answer->joint != NSVCD_NONE) return 0;
  nsvcd__place(p, joints, 1, p->poses);
  if (p->error) return 0;
  nsvcd__add_collision(p, 1, INFINITY, NULL, 1, &cost);
  answer->collides = cost.collides;
  answer->logit = cost.logit;
  answer->pair = cost.pair;
  return !cost.collides;
}

NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options) {
  nsvcd__planner planner;
  if (!nsvcd__planner_settings(problem, options, &planner)) return 0;
  return nsvcd__planner_memory(&planner, NULL);
}

// What the planner knows of a problem beforehand, in its memory.
static void nsvcd__planner_begin(nsvcd__planner *p) {
  nsvcd__stage_init(&p->options, &p->explore);
  nsvcd__stage_init(&p->options, &p->refine);
  nsvcd__stage_init(&p->options, &p->check);
  nsvcd__find_shapes(p);
  for (size_t k = 0; k < p->problem->pair_count; k++) p->queue[k] = (uint32_t)k;
  p->random = p->options.seed;
}

// How far a point of a's bounding sphere is, at most, from where the check has it, as b sees it,
// some share of the way from the poses `from` (B) to the next ones, where those on the spline are
// p->moved.
static float nsvcd__pair_strays(const nsvcd__planner *p, const nsvcd_body_pair *pair,
                                const nsvcd_pose *from, double share) {
  const nsvcd_pose *to = from + p->problem->body_count;
  const nsvcd__sphere *sphere = &p->shapes[pair->a].sphere;
  const nsvcd_pose start = nsvcd__relative_pose(&from[pair->a], &from[pair->b]);
  const nsvcd_pose end = nsvcd__relative_pose(&to[pair->a], &to[pair->b]);
  const nsvcd_pose there = nsvcd__relative_pose(&p->moved[pair->a], &p->moved[pair->b]);
  const nsvcd__d3 begin = nsvcd__d3_load(start.position);
  const nsvcd__d3 place = nsvcd__d3_mix(begin, nsvcd__d3_load(end.position), share);
  const nsvcd__quat q = nsvcd__quat_load(start.rotation);
  const nsvcd__quat r = nsvcd__quat_load(end.rotation);
  const nsvcd__quat checked = nsvcd__quat_slerp(q, r, (float)share);
  const nsvcd__quat is = nsvcd__quat_load(there.rotation);
  const nsvcd__transform at = {nsvcd__mat3_of(is), nsvcd__f3_load(there.position)};
  const nsvcd__transform was = {nsvcd__mat3_of(checked), nsvcd__d3_narrow(place)};
  const nsvcd__f3 x = nsvcd__f3_transform(&at, sphere->centre);
  const nsvcd__f3 y = nsvcd__f3_transform(&was, sphere->centre);
  const float way = nsvcd__f3_length(nsvcd__f3_sub(x, y));
  return way + 2 * nsvcd__f3_length(nsvcd__quat_turn(checked, is)) * sphere->radius;
}

// How far the spline strays from the motion of the last check, whose poses p->poses are: of all
// pairs whose a is given. A smooth curve strays most half way between two of these: there it is
// looked at, beside every so many of them. Where they are few, it is looked at in more places, for
// an S crosses its chord half way. It is no bound: nothing is known of `place` but what it says.
static float nsvcd__stray(nsvcd__planner *p, const float *control) {
  const nsvcd_plan_problem *problem = p->problem;
  const size_t segments = p->check.moments - 1;
  const size_t wanted = NSVCD__STRAY_LOOKS * (p->check.via + 1);
  const size_t stride = wanted < segments ? segments / wanted : 1;
  const size_t looks = 2 * (wanted / segments) + 1;
  float joints[NSVCD_MAX_JOINTS];
  float most = 0;
  for (size_t n = 0; problem->bodies && n / looks * stride < segments; n++) {
    const size_t s = n / looks * stride;
    const double share = (double)(n % looks + 1) / (double)(looks + 1);
    const double t = ((double)s + share) / (double)segments;
    nsvcd_spline(control, p->check.via, problem->joints, (float)t, 0, joints);
    nsvcd__place(p, joints, 1, p->moved);
    if (p->error) break;
    for (size_t k = 0; k < problem->pair_count; k++) {
      const nsvcd_body_pair *pair = &problem->pairs[k];
      const nsvcd_pose *from = p->poses + s * problem->body_count;
      if (problem->bodies[pair->a])
        most = fmaxf(nsvcd__pair_strays(p, pair, from, share), most);
    }
  }
  return most;
}

// Searches from one more start; keeps what it finds in p->result if that is the best so far.
// Returns 1 if there is reason to go on.
static int nsvcd__try_seed(nsvcd__planner *p, nsvcd_plan_answer *found) {
  const size_t f = p->problem->joints;
  const float margin = p->options.margin;
  float deviations[NSVCD_MAX_JOINTS];
  nsvcd__cost cost = nsvcd__no_cost;
  // from the smoothest way, then from random ones
  p->seed = found->seeds;
  nsvcd__smoothest(p, &p->explore, p->control);
  if (p->seed > 0) {
    nsvcd__first_deviations(p, deviations);
    nsvcd__smooth_noise(p, &p->explore, deviations, p->offset);
    nsvcd__change(p, &p->explore, p->control, p->offset, 1, p->trial);
    memcpy(p->control, p->trial, p->explore.bytes);
  }
  nsvcd__explore(p);

  // Nearly the same curve through another number of via points. These are taken into the limits,
  // for a curve may leave them between two points.
  if (p->explore.via != p->refine.via) {
    for (size_t k = 0; k < p->refine.via + 2; k++) {
      const float t = (float)k / (float)(p->refine.via + 1);
      nsvcd_spline(p->best, p->explore.via, f, t, 0, p->trial + k * f);
    }
    nsvcd__change(p, &p->refine, p->trial, p->trial, 0, p->best);
  }

  // until the last check finds it free, with a wider margin each time that the proof finds a hit
  for (size_t push = 0; push <= NSVCD__PUSHES; push++) {
    nsvcd__refine(p);
    cost = nsvcd__cost_of(p, &p->check, p->best, INFINITY, NULL, 1);
    if (nsvcd__is_free(&cost) || p->cancelled || p->error || !cost.proven) break;
    p->options.margin = 2 * p->options.margin + 0.5f;
  }
  p->options.margin = margin;
  const int good = nsvcd__is_free(&cost);
  if (found->seeds == 0 || good || cost.total < found->cost) {
    memcpy(p->result, p->best, p->refine.bytes);
    found->cost = cost.total;
    found->smoothness = cost.smoothness;
    found->stray = nsvcd__stray(p, p->result);
    found->collides = cost.collides;
    found->joint = cost.joint;
    found->logit = cost.logit;
    found->time = cost.time;
    found->pair = cost.pair;
  }
  found->seeds++;
  found->status = NSVCD_PLAN_LIMIT;
  if (good) found->status = NSVCD_PLAN_CONVERGED;
  if (p->cancelled) found->status = NSVCD_PLAN_CANCELLED;
  return !good && !p->cancelled && !p->error && found->seeds < p->options.seeds;
}

NSVCDDEF nsvcd_result nsvcd_plan(const nsvcd_plan_problem *problem,
                                 const nsvcd_plan_options *options, void *workspace,
                                 size_t workspace_size, float *control,
                                 nsvcd_plan_answer *answer) {
  const uint32_t most = nsvcd__magnitude(NSVCD_MAX_COORDINATE);
  nsvcd__planner p;
  nsvcd_plan_answer found;
  if (!nsvcd__planner_settings(problem, options, &p)) return NSVCD_ERROR_ARGUMENT;
  if (!control || !answer) return NSVCD_ERROR_ARGUMENT;
  const size_t needed = nsvcd__planner_memory(&p, NULL);
  if (needed == 0) return NSVCD_ERROR_TOO_LARGE;
  if (!workspace || !nsvcd__is_aligned(workspace)) return NSVCD_ERROR_WORKSPACE;
  if (workspace_size < needed) return NSVCD_ERROR_WORKSPACE;
  for (size_t j = 0; j < problem->joints; j++) {
    const float ends[4] = {problem->low[j], problem->high[j], problem->start[j],
                           problem->goal[j]};
    for (size_t k = 0; k < 4; k++) {
      if (nsvcd__magnitude(ends[k]) > most) return NSVCD_ERROR_NUMBER;
    }
    if (ends[0] > ends[1]) return NSVCD_ERROR_ARGUMENT;
  }

  (void)nsvcd__planner_memory(&p, (char *)workspace);
  nsvcd__planner_begin(&p);
  memset(&found, 0, sizeof found);
  found.joint = NSVCD_NONE;
  found.pair = NSVCD_NONE;
  found.via_points = p.refine.via;
  if (!nsvcd__is_good(&p, problem->start, &found)) {
    found.status = NSVCD_PLAN_START;
  } else if (!nsvcd__is_good(&p, problem->goal, &found)) {
    found.status = NSVCD_PLAN_GOAL;
    found.time = 1;
  }
  nsvcd__smoothest(&p, &p.refine, p.best);
  int more = found.status == NSVCD_PLAN_CONVERGED && !p.error;
  while (more) more = nsvcd__try_seed(&p, &found);
  if (p.error) return p.error;

  memcpy(control, found.seeds ? p.result : p.best, p.refine.bytes);
  found.iterations = p.iterations;
  found.trajectories = p.trajectories;
  found.sweeps = p.sweeps;
  *answer = found;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_OPTIMIZER

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
