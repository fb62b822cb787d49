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
//   nsvcd_mesh_of_faces   faces in memory -> a mesh
//   nsvcd_encode          a mesh -> a body; nsvcd_encode_sphere, _capsule, _box, _cloud: a shape
//   nsvcd_body_load       bytes -> a body, every byte checked
//   nsvcd_body_describe   a body -> its size, box, triangles; is it closed?
//   nsvcd_sweep           a question -> an answer; nsvcd_sweep_batch: many
//   nsvcd_sweep_gradient  a question -> the network's answer, and its derivatives by the poses
//   nsvcd_plan            a start and a goal -> a smooth motion of joints that hits nothing
//   extras/neuralsvcd_robot.h    a robot's joints: is their motion free? Find one that is
//   extras/neuralsvcd_certify.h  an answer -> bytes that prove it, which others can check
//
// OPTIONS, defined before the implementation is included
//   NSVCD_STATIC      all functions are static, in a file that has the implementation
//   NSVCD_NO_STDIO    no file access: no nsvcd_obj_load and the like; nsvcd_obj_parse stays
//   NSVCD_NO_READERS  no readers of OBJ, STL and faces
//   NSVCD_NO_ENCODER  no readers, no nsvcd_mesh_cut, no nsvcd_encode: bodies come from
//                     nsvcd_body_load
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

// ================================================================== interface: what a program sees

// ------------------------------------------------------------------------------- interface/options
// In: the switches that a program defines. Out: the version, switches that follow, NSVCDDEF.

// the version, as in the first line; before 1.0 a minor version may change what a program sees
#define NSVCD_VERSION "0.3.0"
#define NSVCD_VERSION_MAJOR 0
#define NSVCD_VERSION_MINOR 3
#define NSVCD_VERSION_PATCH 0

#if defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_READERS)
#define NSVCD_NO_READERS
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
    "neuralsvcd.h: -ffinite-math-only: bad input is still refused, but results are untested"
#endif

#include <stddef.h>
#include <stdint.h>

#if defined(NSVCD_STATIC) && (defined(__GNUC__) || defined(__clang__))
#define NSVCDDEF static __attribute__((unused))  // few programs call all of them
#elif defined(NSVCD_STATIC)
#define NSVCDDEF static
#else
#define NSVCDDEF extern
#endif
#ifdef __cplusplus
extern "C" {
#endif

// ------------------------------------------------------------------------------- interface/results
// In: nothing. Out: result codes, their texts, and the caller's allocator.

typedef enum nsvcd_result {
  NSVCD_OK = 0,
  // a pointer is NULL that must not be
  NSVCD_ERROR_ARGUMENT,
  // the file is missing or cannot be read
  NSVCD_ERROR_IO,
  // the allocator returned NULL
  NSVCD_ERROR_MEMORY,
  // the memory given is NULL, not aligned to NSVCD_ALIGNMENT, or smaller than needed
  NSVCD_ERROR_WORKSPACE,
  // the caller's progress function cancelled
  NSVCD_ERROR_CANCELLED,
  // a count is 0, or larger than the library takes: of joints, parts, goals, points of a guess
  NSVCD_ERROR_COUNT,

  // ---- files and meshes
  // the file has another format, or is a binary one that is cut short
  NSVCD_ERROR_FORMAT,
  // a line cannot be understood, or a face has one or two vertices
  NSVCD_ERROR_SYNTAX,
  // an index is zero, or refers to no vertex
  NSVCD_ERROR_INDEX,
  // a coordinate is not finite, or larger than NSVCD_MAX_COORDINATE
  NSVCD_ERROR_NUMBER,
  // the mesh has no triangle, no area, or a radius below NSVCD_MIN_RADIUS
  NSVCD_ERROR_EMPTY,
  // more vertices, triangles or bytes than can be counted
  NSVCD_ERROR_TOO_LARGE,
  // a face's size is below three, or the sizes do not add up to corner_count
  NSVCD_ERROR_SIZES,
  // low or high is not finite, or low is not less than high
  NSVCD_ERROR_BOX,
  // more patches than NSVCD_MAX_PATCHES, or patch_radius is negative or not finite
  NSVCD_ERROR_PATCHES,
  // a radius, `convex_radius` or `half` is negative, zero where it must not be, not finite, or
  // beyond NSVCD_MAX_COORDINATE
  NSVCD_ERROR_RADIUS,

  // ---- bodies
  // what is passed as a body is not one, or is damaged, cut short or misaligned
  NSVCD_ERROR_BODY,
  // the body has another version, other weights or the other byte order
  NSVCD_ERROR_VERSION,
  // the body has no triangles, which a proof needs
  NSVCD_ERROR_TRIANGLES,
  // the body has no latents, which the network needs; or latents were asked for in a build without
  // the network, or of a body with a convex radius
  NSVCD_ERROR_LATENTS,

  // ---- questions
  // count must be 0 where poses is NULL, else 1 to NSVCD_MAX_POSES
  NSVCD_ERROR_POSES,
  // times do not rise, or those of a mover do not go from 0 to 1
  NSVCD_ERROR_TIMES,
  // a pose's position is not finite, or beyond NSVCD_MAX_COORDINATE
  NSVCD_ERROR_POSE,
  // a quaternion's length differs from 1 by more than NSVCD_UNIT_TOLERANCE
  NSVCD_ERROR_QUATERNION,
  // a scale is not finite, negative or out of range, or makes a body too small or too large
  NSVCD_ERROR_SCALE,
  // `pivot` is not finite, or, scaled, beyond NSVCD_MAX_COORDINATE; or it is set for a certificate
  NSVCD_ERROR_PIVOT,
  // a and b of a question are the same body in the same motion, so something was passed twice
  NSVCD_ERROR_SAME,
  // `ask` is none of its values
  NSVCD_ERROR_ASK,
  // `method` is none of its values, or cannot answer this: the network has no FIRST, `to`,
  // clearance or slop, and a proof has no gradient
  NSVCD_ERROR_METHOD,
  // `to` is negative, not finite or too large, or set with HIT
  NSVCD_ERROR_TO,
  // `to_time` is not in [0,1], or set without FIRST
  NSVCD_ERROR_TO_TIME,
  // a clearance is negative, not finite or too large
  NSVCD_ERROR_CLEARANCE,
  // `slop` is negative, not finite or too large; or it is set for a certificate
  NSVCD_ERROR_SLOP,
  // `tolerance` is negative, not finite or too large
  NSVCD_ERROR_TOLERANCE,
  // `manifold` is set without FIRST
  NSVCD_ERROR_MANIFOLD,
  // `segments` is not a multiple of 16 up to 64
  NSVCD_ERROR_SEGMENTS,
  // `network.pairs` is more than NSVCD_MAX_PAIRS
  NSVCD_ERROR_PAIRS,
  // `network.model` is none of its values, or not compiled in
  NSVCD_ERROR_MODEL,
  // `network.precision` is none of its values, or not compiled in
  NSVCD_ERROR_PRECISION,
  // `network.recall` is none of its values
  NSVCD_ERROR_RECALL,
  // `network.inflate` is negative or not finite
  NSVCD_ERROR_INFLATE,

  // ---- joints
  // a joint's kind is none of its values, or its parent does not come before it
  NSVCD_ERROR_JOINT,
  // a joint's axis has no length, or is not finite
  NSVCD_ERROR_AXIS,
  // a joint's limits are not finite or too large, or low is above high
  NSVCD_ERROR_LIMITS,
  // a joint's speed or acceleration is negative, not finite or too large
  NSVCD_ERROR_SPEED,
  // a link or a part is not one of the scene's
  NSVCD_ERROR_LINK,
  // a pair is not one of the scene's; or it names a part that is not, one part twice, or two parts
  // on one link
  NSVCD_ERROR_PAIR,
  // a joint's value in a start, a goal or a motion is not finite or too large
  NSVCD_ERROR_VALUE,
  // `degree` is not 1 to NSVCD_MAX_DEGREE, or there are more pieces than can be counted
  NSVCD_ERROR_DEGREE,
  // the motion has no pieces, or too many, or its joints move too far or too fast to be certified
  NSVCD_ERROR_TURN,
  // `finest` is negative or not finite
  NSVCD_ERROR_FINEST,
  // `max_distance` or `max_depth` is negative, not finite or too large
  NSVCD_ERROR_DISTANCE,
  // `farthest` is negative, not finite or too large
  NSVCD_ERROR_FARTHEST,
  // `nodes` or `shortcuts` is too large, or `edge` negative
  NSVCD_ERROR_ROUTE,
  // a planner's stage is out of range
  NSVCD_ERROR_STAGE,
  // a planner's weight, duration or margin is not finite, or it has too many seeds or checks
  NSVCD_ERROR_PLAN,

  // ---- this build
  // the compiler or its flags made a program that computes wrongly
  NSVCD_ERROR_BUILD
} nsvcd_result;

// The text of a result, for people: a sentence without a full stop, never NULL. It names the field
// at fault, as it is called here.
NSVCDDEF const char *nsvcd_result_string(nsvcd_result result);

// Does this build compute correctly on this processor? If not, what it proves may be false. Call
// this once at the start if the compiler is not gcc, clang or MSVC, or if its flags are unusual. It
// takes a microsecond (tests/test_processor.c). It tests how structs and floats are passed,
// vectors, rotations, the test of a plane that proofs rest on, and two triangles. Anything else may
// still be wrong.
//   allocates  nothing
//   errors     BUILD
NSVCDDEF nsvcd_result nsvcd_self_test(void);

// Where memory comes from. A NULL allocator means malloc and free.
//   alloc      returns memory aligned as malloc's, or NULL on failure
//   free       takes back memory that alloc returned
//   user       passed to both
typedef struct nsvcd_allocator {
  void *(*alloc)(size_t size, void *user);
  void (*free)(void *memory, void *user);
  void *user;
} nsvcd_allocator;

// -------------------------------------------------------------------------------- interface/meshes
// In: an OBJ or STL file, or the caller's faces. Out: nsvcd_mesh, or a part of one.

// Triangles. Those that functions here make are freed with nsvcd_mesh_free.
typedef struct nsvcd_mesh {
  // (vertex_count, 3) metres
  float *positions;
  // (triangle_count, 3) vertex numbers from 0, counter-clockwise seen from outside
  uint32_t *indices;
  size_t vertex_count;
  size_t triangle_count;
} nsvcd_mesh;

#ifndef NSVCD_NO_READERS
// Reads OBJ text into a mesh. Only the lines v and f are read; lines end in LF, CR or CR LF. A
// face's corners are v, v/vt, v//vn or v/vt/vn. The number after a slash may be missing, and a
// corner may refer to a vertex further down. Whatever follows x y z (a weight, a colour) is
// skipped, even NaN. Faces of any number of corners are triangulated, concave ones too. A face of n
// corners always makes n - 2 triangles. Triangles are numbered in the order of the faces.
//   text       (size) characters, not NULL; no final NUL or newline is needed
//   allocator  NULL: malloc and free
//   mesh       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   error_line set to the line at fault, from 1, or to 0 if no line is; may be NULL
//   allocates  the mesh, and working memory that is freed again. Time is linear in size, except for
//              concave faces of thousands of corners: n^1.5 for n corners in the worst shapes that
//              tests/test_mesh.c tries
//   errors     ARGUMENT, MEMORY, FORMAT (no line is one of OBJ's), SYNTAX, INDEX, NUMBER (a
//              coordinate in metres), EMPTY, TOO_LARGE. If there are several faults, it is the
//              first one found: statements and counts are checked first, then vertices, then faces
//   source     Wavefront, "Object Files", version 3.0; ear clipping after Meisters 1975
NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// Reads an OBJ file into a mesh, as nsvcd_obj_parse reads a text.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   allocator, mesh, error_line  as for nsvcd_obj_parse
//   errors     those of nsvcd_obj_parse, and IO
NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

// Reads STL, binary or text, into a mesh. Corners at the same position become one vertex; normals
// and attributes are skipped.
//   data       (size) bytes, not NULL
//   allocator, mesh, error_line  as for nsvcd_obj_parse; in a binary file no line is at fault
//   allocates  the mesh, with room for three vertices a triangle, and working memory that is freed
//              again
//   errors     ARGUMENT, MEMORY, FORMAT (it is no text that begins with "solid", nor as long as its
//              count of triangles says), SYNTAX, NUMBER, EMPTY, TOO_LARGE
//   source     3D Systems, "StereoLithography Interface Specification", 1989
NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// Reads an STL file into a mesh, as nsvcd_stl_parse reads bytes.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   allocator, mesh, error_line  as for nsvcd_stl_parse
//   errors     those of nsvcd_stl_parse, and IO
NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

typedef enum nsvcd_mesh_format {
  // STL if it begins with "solid" or is as long as its count of triangles says, else OBJ
  NSVCD_MESH_ANY = 0,
  NSVCD_MESH_OBJ,
  NSVCD_MESH_STL
} nsvcd_mesh_format;

// How a file is read, and how its numbers become metres. That is computed in double. Only then are
// the metres rounded to float, and compared with NSVCD_MAX_COORDINATE. Zero means the default.
typedef struct nsvcd_mesh_options {
  nsvcd_mesh_format format;
  // the point, in the file's units, that becomes the mesh's origin. In a map, whose coordinates are
  // in the millions, choose one near the objects: floats near 5,400,000 are half a metre apart
  double origin[3];
  // metres in one of the file's units: 0.001 for millimetres; default 1
  double scale;
} nsvcd_mesh_options;

// Reads OBJ or STL into a mesh, as nsvcd_obj_parse or nsvcd_stl_parse does, with options.
//   data       (size) bytes, not NULL
//   options    NULL: either format, in metres
//   allocator, mesh, error_line  as for nsvcd_obj_parse; in a binary file no line is at fault
//   allocates  as nsvcd_obj_parse or nsvcd_stl_parse
//   errors     those of nsvcd_obj_parse and nsvcd_stl_parse, SCALE, and NUMBER for an origin that
//              is not finite
NSVCDDEF nsvcd_result nsvcd_mesh_parse(const void *data, size_t size,
                                       const nsvcd_mesh_options *options,
                                       const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                       size_t *error_line);
#ifndef NSVCD_NO_STDIO
// Reads an OBJ or STL file into a mesh, as nsvcd_mesh_parse reads bytes.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   options    NULL: either format, in metres
//   allocator, mesh, error_line  as for nsvcd_mesh_parse
//   errors     those of nsvcd_mesh_parse, and IO
NSVCDDEF nsvcd_result nsvcd_mesh_load(const char *path, const nsvcd_mesh_options *options,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#endif

// Faces of any number of corners, as engines and readers of other formats have them.
typedef struct nsvcd_faces {
  // (vertex_count, 3) metres
  const float *positions;
  // (corner_count) vertex numbers from 0, face after face, counter-clockwise seen from outside
  const uint32_t *corners;
  // (face_count) numbers of corners, 3 or more each, corner_count in all; NULL: all faces are
  // triangles
  const uint32_t *sizes;
  size_t vertex_count;
  size_t corner_count;
  size_t face_count;
} nsvcd_faces;

// Triangulates faces, concave ones too, as nsvcd_obj_parse does.
//   faces      not NULL, not kept
//   allocator  NULL: malloc and free
//   mesh       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   allocates  the mesh, and working memory that is freed again; takes as long as nsvcd_obj_parse
//   errors     ARGUMENT, SIZES, INDEX, NUMBER, EMPTY, TOO_LARGE, MEMORY
//   source     ear clipping after Meisters 1975
NSVCDDEF nsvcd_result nsvcd_mesh_of_faces(const nsvcd_faces *faces,
                                          const nsvcd_allocator *allocator, nsvcd_mesh *mesh);
#endif
#ifndef NSVCD_NO_ENCODER
// Cuts out the part of a mesh that lies in a box. Triangles are cut at the box; vertices are not
// shared. Use it for a large mesh that keeps changing, or for the network, whose patches must not
// be much larger than the gap in question. Encode the part that the moving body can reach (the box
// of its sweep, grown a little) as an `open` body. A mesh that does not change is better encoded
// whole, once.
//   mesh       not NULL
//   low, high  the box in the mesh's frame, metres, not NULL, finite, low < high on each axis
//   allocator  NULL: malloc and free
//   part       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   allocates  the part
//   errors     ARGUMENT, BOX, EMPTY (nothing is in the box), INDEX, NUMBER, TOO_LARGE, MEMORY
//   source     Sutherland and Hodgman 1974
NSVCDDEF nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *mesh, const float low[3],
                                     const float high[3], const nsvcd_allocator *allocator,
                                     nsvcd_mesh *part);
// Frees a mesh that a function here allocated, and empties *mesh.
//   mesh       may be NULL
//   allocator  the one that the mesh came from
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *allocator);
#endif

// -------------------------------------------------------------------------------- interface/bodies
// In: a mesh, or bytes that were a body. Out: nsvcd_body, and facts about it.
//
// CLOSED MESHES
//   Only a closed component of a mesh has an inside. A component is closed if every edge has its
//   reverse, whichever way it is wound as a whole. Some flaws are set aside, since they do no harm
//   to that: faces that occur twice or turned round, fins, inner walls, slivers, and small gaps
//   between corners. A gap is small if it is at most a ten-thousandth of the diagonal of the mesh's
//   box, and at most a hundredth of the longest edge at either corner. (What is thinner than such a
//   gap may slip through it.) A component that is still open encloses nothing for certain.
//   nsvcd_body_facts counts these components.
//
//   An open component with small holes is nearly a solid. Its surface goes on across each hole, as
//   it does not at the rim of a bin, a tube or a floor. Its holes are small if each is a slit or a
//   single triangle, and together they are less than half of the area. They are also small if they
//   are less than a fiftieth of the area, and the component is wound outwards. If something seems
//   to be inside a component that is nearly a solid, a question is UNDECIDED, unless the mesh was
//   encoded as `open`.

// An encoded body: one relocatable blob without pointers, aligned to NSVCD_ALIGNMENT. Copy it with
// memcpy, write it with fwrite, map it, or bake it into flash as a const array. Its size is
// nsvcd_body_facts.size. Threads may share it. Functions that take a body check its first bytes
// (errors BODY, VERSION) and trust the rest.
//
// Floats are IEEE 754, and everything is in the byte order of the machine that encoded the body.
// The blob begins with "NSVB" on a little-endian machine and with "BVSN" on a big-endian one.
// Machines of the other order refuse it.
typedef struct nsvcd_body nsvcd_body;

#define NSVCD_ALIGNMENT 8
// The default number of patches of most bodies with triangles, and of a body for the network alone,
// which needs finer patches than a proof.
#define NSVCD_DEFAULT_PATCHES 192
#define NSVCD_DEFAULT_NETWORK_PATCHES 256
#define NSVCD_MAX_PATCHES 65536
// A body of more patches is a level: its patches are in a tree.
#define NSVCD_SMALL_PATCHES 512
// By default, a mesh of up to NSVCD_VERY_FEW_TRIANGLES has one patch for each triangle, but at
// least NSVCD_LEAST_PATCHES. A mesh of up to NSVCD_MANY_TRIANGLES has one patch for every
// NSVCD_PATCH_TRIANGLES triangles, but at least NSVCD_DEFAULT_PATCHES and at most
// NSVCD_SMALL_PATCHES. A larger mesh is a level, with one patch for every NSVCD_LEVEL_TRIANGLES.
#define NSVCD_LEAST_PATCHES 12
#define NSVCD_VERY_FEW_TRIANGLES 48
#define NSVCD_PATCH_TRIANGLES 50
#define NSVCD_MANY_TRIANGLES 131072
#define NSVCD_LEVEL_TRIANGLES 12
// metres: the largest coordinate of a vertex or a position
#define NSVCD_MAX_COORDINATE 1e6f
// metres: the smallest radius of a body's bounding sphere
#define NSVCD_MIN_RADIUS 1e-12f
// the most poses of a body in a question
#define NSVCD_MAX_POSES 65536
// the scales that a body may have in a question
#define NSVCD_MIN_SCALE 1e-6f
#define NSVCD_MAX_SCALE 1e6f

// A function that is called now and then with the fraction done, in [0,1]. It returns 0 to go on;
// anything else ends the work with NSVCD_ERROR_CANCELLED.
typedef int nsvcd_progress(float done, void *user);

// How a mesh is encoded. Zero means the default.
typedef struct nsvcd_encode_options {
  // N, the number of patches, 1..NSVCD_MAX_PATCHES; default by patch_radius, if that is set, or
  // else by the number of triangles, as above
  size_t patches;
  // metres: the mesh gets as many patches as give each about this radius, if `patches` is 0. For a
  // level, take half the size of the bodies that move in it
  float patch_radius;
  // metres: the body is everything within this distance of the mesh. If it is not 0, triangles need
  // no area: one vertex three times makes a ball, two vertices make a capsule. A body with a convex
  // radius has no latents
  float convex_radius;
  // 1: the mesh is not closed (a sheet, or a part cut out), and nothing is inside it. 0: if
  // something seems to be inside a component that is nearly a solid, a question is undecided; see
  // CLOSED MESHES
  int open;
  // 1: the network can answer as well. The proof needs no latents, which take 93 bytes a patch, and
  // time to encode
  int latents;
  // 1: only the network can answer. The body takes fewer bytes, and there is no proof
  int no_triangles;
  // 1: the proof's triangles are stored with 16 bits a coordinate, for scarce flash. That takes
  // about 5 % fewer bytes, 10 to 40 % fewer for a fine mesh. Verdicts are then about these
  // triangles, which are within nsvcd_body_facts.quantization_error of the mesh's own: a HIT says
  // that the mesh comes that near
  int coarse;
  // called with the fraction done; may be NULL
  nsvcd_progress *progress;
  // passed to `progress`
  void *user;
} nsvcd_encode_options;

#ifndef NSVCD_NO_NETWORK
// Bytes of a body without triangles; 0 if there can be no such body. A body with triangles is
// larger: let nsvcd_encode allocate it.
//   patches    1..NSVCD_MAX_PATCHES
NSVCDDEF size_t nsvcd_body_size(size_t patches);
// nsvcd_body_size as a constant, for 1 to NSVCD_SMALL_PATCHES patches.
#define NSVCD_BODY_BYTES(patches) \
  ((64 + 52 * (((patches) + 15) / 16 * 16) + 16 * ((((patches) + 15) / 16 + 15) / 16 * 16) + \
    40 * (patches) + 7) / \
   8 * 8)
#endif

#ifndef NSVCD_NO_ENCODER
// Encodes a mesh into a body. It may have fewer patches than asked for, if the surface has too few
// distinct points. The same mesh gives the same bytes, in one build: see DETERMINISM below.
//   mesh       not NULL; not kept
//   options    NULL: the defaults, for the proof
//   allocator  NULL: malloc and free
//   memory     (capacity) bytes, aligned to NSVCD_ALIGNMENT, for the body. NULL: the body comes
//              from the allocator; free it with nsvcd_body_free
//   body       not NULL; set to the body, or left as it was on failure
//   allocates  working memory, which is freed again, and the body if memory is NULL
//   errors     ARGUMENT, PATCHES, RADIUS (`convex_radius`), LATENTS, INDEX, NUMBER, EMPTY,
//              TOO_LARGE, MEMORY, WORKSPACE, CANCELLED
//   source     the latents: NeuralSVCD, appendix F; the triangles: this library
NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *allocator, void *memory,
                                   size_t capacity, const nsvcd_body **body);
#ifndef NSVCD_NO_PROOF
// Encode bodies of simple shapes, for the proof: a sphere, a capsule, a box, a cloud of spheres.
// They are exact but for rounding to float. Each is what nsvcd_encode makes of a point, a segment,
// a box or points with options.convex_radius. They are faster to query than meshes of many
// triangles: a capsule is a single segment.
//
// A cloud may be a map of voxels, of which it has the centres. With a radius of 0.8661 edges it
// contains the cubes; with half an edge it lies within them. Only a mesh of their faces is exact.
// Keep a map that changes in chunks of about 16 x 16 x 16 cells, each a body. Encode only those
// anew that changed, and ask about all that are near with nsvcd_sweep_batch.
//   radius, convex_radius  metres, > 0; a box's may be 0
//   from, to        the ends of the capsule's axis, not NULL, metres; may be the same
//   half            half the box's lengths, including convex_radius and no less than it; (3)
//                   metres, not NULL
//   points          (count, 3) centres of the spheres, metres, not NULL, not kept
//   allocator       NULL: malloc and free
//   body            not NULL; set to the body, or left as it was on failure. Free it with
//                   nsvcd_body_free. A sphere and a box are centred at the origin; a capsule and
//                   a cloud lie where their ends and points do
//   allocates       the body, and working memory, which is freed again
//   errors          ARGUMENT, RADIUS, NUMBER, EMPTY, TOO_LARGE, MEMORY
//   source          this library
NSVCDDEF nsvcd_result nsvcd_encode_sphere(float radius, const nsvcd_allocator *allocator,
                                          const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_capsule(const float from[3], const float to[3],
                                           float radius, const nsvcd_allocator *allocator,
                                           const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_box(const float half[3], float convex_radius,
                                       const nsvcd_allocator *allocator,
                                       const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_cloud(const float *points, size_t count, float radius,
                                         const nsvcd_allocator *allocator,
                                         const nsvcd_body **body);
#endif
// Frees a body that nsvcd_encode or one of the shapes allocated.
//   body       may be NULL; what does not begin as a body does is left alone
//   allocator  the one that the body came from
NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *allocator);
#endif

// Takes untrusted bytes for a body, after checking every one of them.
//   memory     (size) bytes, not NULL, aligned to NSVCD_ALIGNMENT; the body stays in it
//   body       not NULL; set to the body, or left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (NULL), VERSION (the body has another version, other weights or the other
//              byte order), BODY (anything else is wrong)
NSVCDDEF nsvcd_result nsvcd_body_load(const void *memory, size_t size,
                                      const nsvcd_body **body);

// Takes bytes for a body that are known to be as nsvcd_encode made them. Only the header is
// checked: version, weights and size. Use it for an array baked into the program, or for a large
// mapped file that was loaded once before, whose pages are then read as queries need them. Bytes
// that have changed since do harm: answers are wrong, or reads go out of bounds.
//   memory     (size) bytes, not NULL, aligned to NSVCD_ALIGNMENT; the body stays in it
//   body       not NULL; set to the body, or left as it was on failure
//   allocates  nothing
//   errors     those of nsvcd_body_load
NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body);

// Writes a copy of a body, scaled about its origin: for a planner, or to bake it. A question needs
// no such copy, since a mover has a scale. Latents do not depend on scale, and answers scale along,
// up to rounding.
//   body       not NULL
//   scale      > 0
//   memory     (capacity) bytes, as many as the body has or more, not NULL, aligned to
//              NSVCD_ALIGNMENT; may be the body's own
//   scaled     not NULL; set to the copy, or left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, BODY, VERSION, SCALE (also if the copy would be smaller or larger than a
//              body may be), WORKSPACE, TRIANGLES (only with NSVCD_NO_PROOF, which cannot scale
//              them)
NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, float scale, void *memory,
                                       size_t capacity, const nsvcd_body **scaled);

// What a body is. The mesh is the one that it was encoded from, in the body's frame.
typedef struct nsvcd_body_facts {
  // bytes of the body
  size_t size;
  // N, the number of patches
  size_t patches;
  // metres: a sphere that contains the body
  float centre[3];
  float radius;
  // metres: no point of the mesh is farther from the body's origin
  float extent;
  // metres: a box that contains the mesh; 0 if no triangles are stored
  float low[3], high[3];
  // metres
  float mean_patch_radius;
  // number of the mesh's triangles; 0: none are stored
  size_t triangles;
  // number of entries, which are triangles, and parts of them, patch by patch
  size_t stored_triangles;
  // metres: the triangles that verdicts are about are within this of the mesh's. 0: they are the
  // mesh's own floats. Otherwise the body is coarse, or nsvcd_body_scale has rounded it
  float quantization_error;
  // metres by which the body exceeds its mesh
  float convex_radius;
  // 1: the network can answer
  int latents;
  // number of the mesh's components, and of those among them that are open (see CLOSED MESHES);
  // both are 0 if no triangles are stored. No open ones: all of the mesh is solid
  size_t components, open_components;
  // number of edges of the open components that have an odd number of triangles, mostly one
  size_t open_edges;
  // 1: the mesh was encoded as `open`
  int open;
} nsvcd_body_facts;

// Describes a body. If it is none, all facts are 0.
//   body       may be NULL
NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body);

// Writes the sphere of one patch. Returns 1; or 0, writing nothing, if there is no such patch or
// body.
//   body       may be NULL
//   patch      a number, as nsvcd_answer has it
//   centre     not NULL, metres, body frame
//   radius     not NULL, metres
NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius);

// ------------------------------------------------------------------------------- interface/queries
// In: two movers and options. Out: an answer, and its derivative.
//
// WHAT AN ANSWER IS WORTH
//   By proof, the default, FREE and HIT are facts. They are about the surfaces of the two meshes,
//   and about the motion as nsvcd_sweep describes it. The theorem stands in proof/proof, and
//   tests/test_proof.c replays its certificates in double precision. UNDECIDED comes with a reason,
//   nsvcd_why, and with the network's opinion where it has one.
//
//   By the network, everything is an opinion. Its measured error rates are in
//   tests/bench/RESULTS.md: two to six of a hundred answers are wrong where bodies of 0.1 to 0.4 m
//   come within a millimetre of each other. If a wrong answer does harm, ask for a proof. Whether
//   one body is inside the other is estimated by a winding number of patches, which is reliable for
//   closed meshes.
//
// NUMERIC ROBUSTNESS, as measured by `make race`, `make bench`, tests/test_proof.c and
// tests/bench/extremes.sh
//   A query computes in float32, but for triangle pairs and containment, which are computed in
//   double.
//   Range         Coordinates reach up to NSVCD_MAX_COORDINATE. Radii of bodies begin at
//                 NSVCD_MIN_RADIUS, below which squares underflow. Proofs are tested from 3e-11 to
//                 3e5 m.
//   Rounding      Proofs allow for NSVCD__ROUNDING, two millionths, of the distances and extents
//                 involved: 2 um for bodies of 0.3 m, 80 um if one measures 20 m. Surfaces must be
//                 farther apart than that, and little more, to be certified free.
//   Quantization  Triangles of a coarse or scaled body are off by a few micrometres at most, if it
//                 measures 0.3 m.
//   Far away      Positions are first taken relative to one body, which is the one that rests, or
//                 else the larger. Everything is computed in its frame, in units of its scale. So a
//                 scene 10 km from the origin loses only what its own coordinates lose, about 1 mm.
//   Resolution    The network needs patches that are not much larger than the clearance in
//                 question. For a body of 5 cm against one of 20 m, with 256 patches each, 62 % of
//                 its answers near contact are right (RESULTS.md, *mixed*). Cut the large mesh to
//                 what the motion can reach, with nsvcd_mesh_cut. For a proof, the size of patches
//                 decides only what an answer costs.
//   Bad numbers   NaN and infinity are refused, also under -ffast-math: their bits are tested.
//
// DETERMINISM
//   One binary on one processor makes the same blob of a mesh, the same answer to a question and
//   the same plan, to the bit, whatever the workspace held and in any thread. There is one
//   exception: an answer of nsvcd_sweep_batch may depend on the question before it.
//
//   Two builds round differently if their compilers, flags or libms differ. So does one build on
//   two processors that select different vectors. Given the same blobs, one never refutes what the
//   other proves: by the theorem, every proven verdict is true. But one may leave undecided what
//   the other proves, and times, points, patches and work differ.
//
//   The network's logits differ by more than rounding. Its search ends at the first pair that is
//   clear. Where a pair is near that bound, or near another pair in rank, two builds may answer by
//   different pairs or decoders. So the network's verdict may differ where the logit is near 0, or
//   the ranker's near its bounds of +-3. So may bodies that two builds encode, and plans. The
//   joints of nsvcd_plan and neuralsvcd_robot.h are placed by libm's sines.
//
//   NSVCD_ONE_PATH makes blobs without latents, and answers by proof, the same to the bit with
//   SSE2, AVX2, AVX-512, NEON, SIMD128 and plain C, so that two machines replay a game alike. It
//   does the same operations in the same order, fuses no products into sums, and has its own sines
//   and angles. It costs 4 to 14 % of the time (`make bench-one-path`). The compiler must not fuse
//   either: gcc does unless it is told -std=c99 or the like, or -ffp-contract=off; clang does with
//   -ffp-contract=fast. In a build that fuses, nsvcd_self_test returns BUILD.

// The place of a body. A point x of its frame is at `rotation` x + position in the world.
typedef struct nsvcd_pose {
  float position[3];  // metres
  // unit quaternion x y z w; its length is 1 within NSVCD_UNIT_TOLERANCE
  float rotation[4];
} nsvcd_pose;

#define NSVCD_UNIT_TOLERANCE 1e-4f

// What is asked about two moving bodies.
typedef enum nsvcd_ask {
  // do they hit each other at all? The search ends at any contact. The answer's time is that of
  // this contact, which is usually not the first
  NSVCD_ASK_HIT = 0,
  // do they, and when first? The answer also says how far the bodies may move
  NSVCD_ASK_FIRST,
  // do they, and how near do they come? The answer's time is that of some contact, as for HIT. The
  // network gives its opinion of the distance if it is named as the method
  NSVCD_ASK_DISTANCE
} nsvcd_ask;

// How a question is answered.
typedef enum nsvcd_method {
  // by proof where both bodies have triangles, else by the network
  NSVCD_METHOD_DEFAULT = 0,
  NSVCD_METHOD_PROOF,   // facts
  NSVCD_METHOD_NETWORK  // an opinion, in strictly bounded time
} nsvcd_method;

// The network's decoders. All decode the same latents. They take about 4, 13 and 40 thousand
// multiplications for each pair of patches.
typedef enum nsvcd_model {
  // the largest that is compiled in
  NSVCD_MODEL_DEFAULT = 0,
  NSVCD_MODEL_TINY,
  NSVCD_MODEL_SMALL,
  NSVCD_MODEL_BASE
} nsvcd_model;

// The decoder's arithmetic. Latents are int8 in any case.
typedef enum nsvcd_precision {
  NSVCD_PRECISION_FLOAT = 0,
  NSVCD_PRECISION_INT8
} nsvcd_precision;

// Options of the network. Zero means the default.
typedef struct nsvcd_network_options {
  // K, the number of patch pairs that are decoded, 1..NSVCD_MAX_PAIRS; default NSVCD_DEFAULT_PAIRS
  size_t pairs;
  nsvcd_model model;
  nsvcd_precision precision;
  // fraction of collisions to be found: 0.99f, 0.999f or 0.9999f; default 0, balanced errors
  float recall;
  // fraction of their radii by which patches are inflated before planes separate them; default as
  // much as `recall` needs, or 1 for a distance. Patches that only come near are then decoded too:
  // the logit rises before contact and has a gradient there, but more near misses are called hits
  float inflate;
} nsvcd_network_options;

// units of work for DISTANCE and for checks of joints
#define NSVCD_DEFAULT_WORK 100000
// units of work for HIT and FIRST; only close fits need as many
#define NSVCD_DEFAULT_VERDICT_WORK 10000000
#define NSVCD_NO_TRIANGLE 0xffffffffu
// the most contacts of an answer
#define NSVCD_MAX_CONTACTS 4
#define NSVCD_DEFAULT_PAIRS 8
#define NSVCD_MAX_PAIRS 256
// the logit of a proven hit; proven free is its negative
#define NSVCD_LOGIT_CERTAIN 100.0f
// the default of `to`, as a fraction of the radius of the smaller body's sphere
#define NSVCD_DEFAULT_TO 0.001f

// no index
#define NSVCD_NONE ((size_t)-1)
#define NSVCD_MAX_JOINTS 32

// Two bodies that can meet, by their indices.
typedef struct nsvcd_body_pair {
  uint32_t a, b;
} nsvcd_body_pair;

// A body in a question: its motion and its size. Many movers may share one body.
typedef struct nsvcd_mover {
  // the body, from nsvcd_encode, nsvcd_body_load, nsvcd_body_trust or nsvcd_body_scale
  const nsvcd_body *body;
  // (count) poses. Between two of them the rotation is a slerp, and the position of the pivot is
  // linear in time. One pose: the body rests there. NULL, with count 0: it rests at the origin
  const nsvcd_pose *poses;
  // number of poses, up to NSVCD_MAX_POSES
  size_t count;
  // (count) times of the poses, from 0 to 1, each at least 1e-7 after the one before; they are
  // rounded to 2^-32. NULL: uniform
  const float *times;
  // scale of the body about its origin, NSVCD_MIN_SCALE..NSVCD_MAX_SCALE; default 1
  float scale;
  // the pivot, a point of the body's frame before scaling: between two poses it goes straight, and
  // the body turns about it. Default its origin. A body in flight turns about its centre of mass, a
  // door about any point of its hinge, a screw about any point of its axis
  float pivot[3];
} nsvcd_mover;

// A question about two bodies. Zero is the default of everything but the bodies.
typedef struct nsvcd_question {
  // the bodies. Either may move, or both, over the same time; their counts of poses may differ
  nsvcd_mover a, b;
  nsvcd_ask ask;
  // metres: how exact the answer has to be; not set with HIT. FIRST: no point of one body travels
  // farther than this from time.low to time.high, as the other body sees it. Nor does it travel
  // more than a quarter of its whole way, if triangles are stored that exactly. DISTANCE: the
  // bracket is no wider than this and the quantization errors. Default NSVCD_DEFAULT_TO, unless
  // to_time is set
  float to;
  // how exact a FIRST has to be, as a fraction of the motion, up to 1: time.low to time.high is no
  // longer than this. If `to` is set as well, both hold. Default: only `to` holds
  float to_time;
  // metres: coming within this distance is a hit; default 0: only meeting is
  float clearance;
  // metres: a contact at the start does not count if it is no deeper than this. So a body may rest
  // on another, slide along it or leave it. Its depth is that of the penetration, or of the
  // violation of the clearance, or the sum of both.
  //   The question is then about a body that is pushed out by the slop (answer.push_out), along the
  // normals of all that it touches at the start. Surfaces nearer than a twentieth of the slop count
  // as touching.
  //   With FIRST, so do surfaces nearer than `to`, up to half of the slop. A body that was stopped
  // before a contact can then go on: entering it by less than the slop is FREE, although HIT, which
  // has no `to`, reports a contact. Where surfaces were so near but did not touch, answer.depth
  // is 0
  float slop;
  // metres: surfaces that come within the clearance and this together, but not within the
  // clearance, may be left undecided
  float tolerance;
  // FIRST: 1 reports up to NSVCD_MAX_CONTACTS contacts, which hold the body; default one contact
  int manifold;
  nsvcd_method method;
  // units that a proof may take, approximately; default NSVCD_DEFAULT_VERDICT_WORK, for DISTANCE
  // NSVCD_DEFAULT_WORK. By default, each interval of a long motion (see nsvcd_sweep) may take as
  // much, so that the limit grows with the length.
  //   A unit is one search for a plane between two patches, 16 triangles against the box of 16, one
  // triangle against 16, two triangles at one time, or a ray against 16 triangles or one.
  //   A limit that is given is for the whole motion, in the order of time. When it is reached, the
  // answer tells what was proven by then. DISTANCE divides what is left among the intervals by
  // their length.
  //   An eighth of the limit (by default, of NSVCD_DEFAULT_WORK) is a reserve. Once surfaces have
  // come too near to tell, only the reserve is left. FIRST spends it on what follows them, and the
  // rest of the limit on what precedes them. FIRST also has the reserve for what is undecided when
  // the limit is reached: until when the motion is free, and whether the bodies meet at all. A
  // manifold may take another eighth, and so may the pose of a pushed-out body. Apart from these
  // eighths, a question takes the same work whatever the limit
  size_t work;
  // the most segments that a motion, or each interval of a long one, is cut into: 16, 32, 48 or 64;
  // default 64. Fewer segments take less memory, and make intervals shorter
  size_t segments;
  // options of the network, if it answers. The network has no FIRST, no clearance and no slop, and
  // does not bracket a DISTANCE: `to` is for proofs
  nsvcd_network_options network;
} nsvcd_question;

typedef enum nsvcd_verdict {
  // neither is known; nsvcd_answer.why has the reason
  NSVCD_UNDECIDED = 0,
  // the surfaces never come within the clearance, and no part of one body is inside the other
  NSVCD_FREE,
  // the surfaces come within the clearance, or one body, or a part of it, is inside the other at
  // the start
  NSVCD_HIT
} nsvcd_verdict;

// The verdict in one word; never NULL.
NSVCDDEF const char *nsvcd_verdict_string(nsvcd_verdict verdict);

// Which method reached the verdict.
typedef enum nsvcd_by {
  // a fact. Bodies without triangles can also be FREE by proof, if spheres that cover their
  // surfaces never meet. Whether one of them is inside the other is then still an estimate
  NSVCD_BY_PROOF = 0,
  // an opinion
  NSVCD_BY_NETWORK
} nsvcd_by;

// Why part of the question is not answered.
typedef enum nsvcd_why {
  // all of it is answered
  NSVCD_WHY_NOTHING = 0,
  // surfaces come too near each other without meeting: within question.tolerance, or within 1e-9 of
  // all lengths, or, if a body is coarse or scaled, within the quantization errors. Or eight rays
  // could not tell whether one body is inside the other
  NSVCD_WHY_TOO_NEAR,
  // question.work was not enough
  NSVCD_WHY_WORK,
  // a part of one body seems to be inside the other at the start, and the other is nearly a solid
  // but not closed (see CLOSED MESHES). If nothing is inside it, encode it as `open`
  NSVCD_WHY_OPEN
} nsvcd_why;

// A bracket: the number is no less than `low` and no more than `high`.
typedef struct nsvcd_range {
  float low, high;
} nsvcd_range;

// Two triangles, and where they meet or are nearest.
typedef struct nsvcd_contact {
  // metres, world: where the triangles meet, or else the point of b's that is nearest to a's. If b
  // has a convex radius, the point is on b's surface. Large triangles are stored in parts: the
  // point is on the part examined last
  float point[3];
  // unit, world: the direction from b to a, against the motion. Let v be the velocity of a's point
  // relative to b's; if the contact is at a pose, just before that. If a motion has led to the
  // contact, v . normal <= 0.
  //   Triangles that are apart have the direction from b's nearest point to a's. Triangles that
  // meet have the direction in which they met, by their velocities at that time. A corner on a face
  // has the face's normal, on the side that the corner came from, whatever the winding. An edge
  // across an edge has the direction across both. A corner on a corner or an edge, or an edge along
  // an edge, has the direction most against v of all that still separated them.
  //   Two kinds of normals may point along v. Triangles that touch from the start have the
  // direction of least depth, out of closed surfaces. A manifold has points where both faces are
  // being left.
  //   The normal is 0 if no triangles are named, or if they have no area and so no direction
  float normal[3];
  // metres: the distance of the stored triangles, less convex radii; 0: they meet. In a manifold it
  // is the distance at that point
  float gap;
  // time of the contact in [0,1], rounded up
  float time;
  // the triangles' numbers in the caller's meshes; NSVCD_NO_TRIANGLE if none are named
  uint32_t triangle_a, triangle_b;
  // the patches that hold these triangles
  uint32_t patch_a, patch_b;
  // in a manifold: a number of the corner, or of the two edges, that touch. It stays the same as
  // long as these touch
  uint32_t id;
} nsvcd_contact;

// Where the bodies may go: their poses at a time until which they are free of each other, pushed
// out of what they touch. There is no such pose if they are in contact at the start and no push-out
// ends that (answer.depth is HUGE_VALF), or if one body is, or may be, inside the other. Then the
// poses are those at the start, as the caller gave them.
typedef struct nsvcd_safe_pose {
  // time of the poses: time.low of the answer. If the bodies are about to touch then, it is a
  // little less, by the error of poses in float and of coarse triangles
  float time;
  // world. The push-out is in the pose of a, or of b if only b moves. A slop below the resolution
  // of floats at that distance from the origin is lost in rounding
  nsvcd_pose a, b;
} nsvcd_safe_pose;

// What the network estimates.
typedef struct nsvcd_opinion {
  // 1: the network was asked. 0: everything here is 0
  int asked;
  // logit of a collision; positive means yes. It is the largest of the pairs decoded, less the
  // threshold for `recall`. The search ends at the first logit above 3. Where the tiny decoder,
  // which ranks the pairs, is clear (beyond +-3), its logit is the answer. NSVCD_LOGIT_CERTAIN or
  // its negative: no decoder was needed. DISTANCE: the logit of the pair that comes nearest
  float logit;
  // metres: the gap of the pair that `logit` is of; if negative, the depth. HUGE_VALF: no decoder
  // was needed. DISTANCE: the least gap of all pairs decoded, which within a patch's radius of
  // contact is usually right to a tenth of that radius. For other questions it is a by-product
  float distance;
  // time in [0,1] at which the most suspicious pair comes closest
  float time;
  // the patches of that pair
  uint32_t patch_a, patch_b;
  // number of patch pairs whose spheres meet and that no plane separates, until the search ends. A
  // pair counts once in each interval of time
  size_t candidates;
  // 1: there were more candidates than `pairs` let through
  int limited;
} nsvcd_opinion;

// What is known. Each field means the same whatever was asked and by which method. Unknown numbers
// are HUGE_VALF, unknown counts 0.
typedef struct nsvcd_answer {
  nsvcd_verdict verdict;
  nsvcd_by by;
  // the reason if the verdict is UNDECIDED, or if a bracket of the time or distance is wider than
  // the question says; else NSVCD_WHY_NOTHING. Of several reasons the first in this order is given:
  // OPEN; WORK, if it is the bracket of a DISTANCE that is too wide; TOO_NEAR; WORK
  nsvcd_why why;
  // 1: a hit because one body, or a part of it, lies inside the other at the start, by proof or by
  // the network's estimate. Their surfaces may meet as well: HIT without a slop does not look
  int inside;
  // time of the first contact, in [0,1]: the bodies are free of each other before `low`, and in
  // contact at `high`. FIRST: both are as close together as `to` and to_time say. HIT and DISTANCE:
  // low is 0, and high is the time of some contact, perhaps not the first. By the network, high is
  // when the pair that it suspects comes closest. FREE: both are 1
  nsvcd_range time;
  // metres: the least distance over the motion, or up to time.high if that is known. The distance
  // of a hit is at most the clearance. Quantization errors are allowed for, so `high` may be above
  // 0 even where the surfaces meet
  nsvcd_range distance;
  nsvcd_safe_pose safe;
  // metres: how deep a contact at the start is, to within a few per cent and quantization errors.
  // That is the length of the smallest push-out of a from b that ends it, along normals of what
  // touches, or across two of its edges. The push-out goes up to the slop along each of these, so
  // it may be longer where it combines several. 0: there is no contact at the start
  float depth;
  // metres, world, at the start: how a was pushed out of b for the slop. The answer is about the
  // motion displaced by it, which touches nothing at the start. The push-out turns with b; or with
  // a, if a rests, or if both move and a's extent, convex radius included, is the larger.
  //   It is 0 if nothing touched or was near enough to count. It is also 0 if no push-out helps,
  // since a is pressed in deeper than the slop or held from all sides. Then the contact counts
  float push_out[3];
  // number of contacts at time.high, of a HIT with known triangles: one, or those of a manifold
  size_t contact_count;
  // the contacts. A manifold has those four points that span the largest area, of all that are no
  // farther apart than the clearance and `to` (its default if only to_time is given). They are in
  // the order of their ids
  nsvcd_contact contacts[NSVCD_MAX_CONTACTS];
  // the two triangles that distance.high is about, whatever the verdict. HIT: the contact that was
  // found. UNDECIDED: two that come too near to tell, for FIRST the earliest such. No triangles are
  // named if none were found. If one body is inside the other, only the point is set, to a point of
  // the inner body
  nsvcd_contact nearest;
  nsvcd_opinion opinion;
  // units that the proof took
  size_t work;
} nsvcd_answer;

// Bytes of workspace that nsvcd_sweep needs; 0 if the question is refused. They depend on the sizes
// of the bodies, the method, the segments, and the network's pairs and model.
//   question   NULL: enough for any question
NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question);

// Answers a question. The same question gets the same answer, in one build (see DETERMINISM), and
// the same verdict if a and b are swapped.
//   question   not NULL
//   workspace  (workspace_size) bytes, nsvcd_sweep_workspace_size(question) or more, not NULL,
//              aligned to NSVCD_ALIGNMENT
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     ARGUMENT, WORKSPACE, BODY and VERSION (by a body's first bytes), SAME, TRIANGLES or
//              LATENTS if a body lacks what the method needs, and the code of the field at fault:
//              POSES, TIMES, POSE, QUATERNION, SCALE, PIVOT; ASK, METHOD, TO, TO_TIME, CLEARANCE,
//              SLOP, TOLERANCE, MANIFOLD, SEGMENTS; PAIRS, MODEL, PRECISION, RECALL, INFLATE
//   source     the proof: this library, proof/proof; the network: NeuralSVCD, algorithm 1
//
// What is proven is about the surfaces of the two meshes, scaled and posed exactly as described.
// FREE and HIT hold for the meshes' own floats. The triangles of a HIT meet, or come within the
// clearance, to 1e-12 of all lengths: both extents and the distance of the bodies. A question is
// UNDECIDED if surfaces come within 1e-9 of these lengths without meeting, or if it takes more work
// than allowed. Bodies that are coarse or were scaled have a quantization error, which
// nsvcd_body_facts tells. Their HIT is one to within both bodies' errors, and surfaces nearer than
// these errors are undecided.
//
// More work never leaves undecided what less decides. Nor does it take more units for that, unless
// less has reached its last eighth (DISTANCE: its half). For FIRST, time.low rises with the work,
// and is 0 only if the first moments of the motion take more than a sixteenth of the work.
//
// A motion of any length, up to NSVCD_MAX_POSES poses of each body, is one question, and takes no
// more memory than a short one. More poses are refused with NSVCD_ERROR_POSES. Times are floats:
// among 65,536 poses they resolve a 250th of the time from one to the next.
//
// A long motion, with more than 64 poses or more than 1,280 degrees of turn, is searched interval
// by interval, in the order of time. An interval has as many arcs from pose to pose as make 64
// segments, or question.segments, of at most 20 degrees each. Easy parts are searched in much
// larger intervals. HIT tries both ends of the motion first. FIRST ends with the interval that has
// the first contact. After an undecided interval, later ones are only asked whether the bodies meet
// at all.
//
// What it costs: let Ga and Gb be the bodies' numbers of groups of 16 patches. Let S be the number
// of segments of the motion or interval: about 16 up to 320 degrees of turn, 64 at most. The search
// takes at most 18 S Ga Gb + 3 S tests of 16 spheres against one. In a body of more than 512
// patches, only groups that the other body comes near count. About 16 more tests are made there for
// each level of spheres, and for each 16 spheres of it that the other body comes near. Then a proof
// takes up to question.work units. The network takes 18 S more tests, since it searches a first
// pair of groups twice. It runs the tiny decoder on 12 K pairs and the chosen one on K (the tiny
// alone: on 3 K), and computes 32 distances for each patch.
NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer);

// Workspace sizes as constants, for arrays of a fixed size, slightly larger than needed. For both
// methods, take the larger.
//   patches_a, patches_b patches of the bodies, or more
//   segments             question.segments, 16 to 64
//   pairs                question.network.pairs, K
// NSVCD_MEMORY declares an aligned array:
//   static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(64, 192, 16));
#define NSVCD_MEMORY(name, bytes) uint64_t name[((bytes) + 7) / 8]
#define NSVCD__GROUPS_OF(patches) ((patches) > 512 ? 32 : ((patches) + 15) / 16)
#define NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) \
  (1088 + 704 * (segments) + 8 * NSVCD__GROUPS_OF(patches_a) * NSVCD__GROUPS_OF(patches_b) + \
   ((patches_a) > 512 || (patches_b) > 512 ? 1024 : 0))
#define NSVCD_PROOF_WORKSPACE_BYTES(patches_a, patches_b, segments) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 24832 + 168 * (segments))
#define NSVCD_NETWORK_WORKSPACE_BYTES(patches_a, patches_b, segments, pairs) \
  (NSVCD__SEARCH_BYTES(patches_a, patches_b, segments) + 576 + 32 * (segments) + 112 * (pairs))

// Answers many questions, such as a frame of a game or a sampling planner has. The answers are
// those of nsvcd_sweep, to the bit, with one exception. If a question and the one before it ask the
// network about the same two bodies, the pair of patches that collided before is tried first. If
// that pair collides clearly again (logit above 3), it is the answer, and nothing else is searched.
//   questions  (count); count may be 0
//   workspace  (workspace_size) bytes, as for nsvcd_sweep, large enough for each question
//   answers    (count); left as they were on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     those of nsvcd_sweep, for the first question that has one
//   source     this library; physics engines call it temporal coherence
NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers);

#ifndef NSVCD_NO_GRADIENT
// Answers a question by the network, with the derivatives of its logit by the poses of a and b. For
// DISTANCE they are the derivatives of opinion.distance, along which lies the shortest way out.
// Whatever drives the poses (joints, a spline) goes on from there by the chain rule.
//   question   its method is not PROOF, and it asks nothing that only a proof answers
//   workspace, answer   as for nsvcd_sweep
//   gradient_a, gradient_b   (count, 6), one row for a body without poses; one of them may be NULL;
//              left as they were on failure. A pose's row has the derivatives by a displacement of
//              the body's origin (metres, world axes), then by a small rotation about that origin
//              (rotation vector, radians, world axes, applied on the left)
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     those of nsvcd_sweep
//   source     reverse mode; this library
//
// The gradient is that of the pair and the interval of time that decided. It is zero if no decoder
// was needed, and for poses that do not affect that pair. As a maximum over pairs, the logit has
// kinks. Others come from the network (ReLU) and from a pair's frame, and there are some where a
// flat patch does not turn. There is one where nothing moves: the gradient is then the mean of both
// its sides. The ends of the interval move with the poses, except at t = 0 and 1 and where a
// segment of the search begins or ends. The unit of length, and the spheres' allowance for the
// motion between keyframes, are taken as constant. With int8 it is the derivative of the float
// decoder, or, if that is compiled out, of the function that int8 rounds.
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b);
#endif

// --------------------------------------------------------------------------------- interface/plans
// In: a planning problem, or control points. Out: control points, or the joints at a time.
//
// A trajectory of F joints is a spline through control points: the start, M via points and the
// goal, at uniform times t in [0,1]. They are an array `control` (M + 2, F). Between two of them
// the spline has degree five. At a via point its velocity and acceleration are central differences
// of the control points; at both ends it rests. So both are continuous everywhere.

#ifndef NSVCD_NO_OPTIMIZER
#define NSVCD_MAX_VIA_POINTS 32
// the most segments of a stage of the planner
#define NSVCD_MAX_PLAN_SEGMENTS 4096

// Evaluates a spline: tells where the joints are at a time, or their derivatives by t.
//   control    (via_points + 2, joints) radians or metres, not NULL
//   via_points M, up to NSVCD_MAX_VIA_POINTS; if more, nothing is written
//   joints     F, the number of joints
//   t          time, clamped to [0,1]
//   derivative 0: the joints; 1, 2, 3: velocity, acceleration, jerk; if more, nothing is written
//   out        (joints), not NULL
//   allocates  nothing
//   source     quintic Hermite interpolation, as the paper's authors use it
NSVCDDEF void nsvcd_spline(const float *control, size_t via_points, size_t joints, float t,
                           size_t derivative, float *out);

typedef enum nsvcd_plan_status {
  // the trajectory is within the limits and free of collision. That is proven where bodies have
  // triangles; otherwise it is so as far as the network knows. It is about the motion of the last
  // check, from which the trajectory deviates by answer.deviation
  NSVCD_PLAN_CONVERGED = 0,
  // the iterations ended before a free trajectory was found; this is the best
  NSVCD_PLAN_LIMIT,
  // the progress callback ended the search; this is the best trajectory so far
  NSVCD_PLAN_CANCELLED,
  // the start is out of the limits or in collision; `control` is the smoothest path to the goal
  NSVCD_PLAN_START,
  // the goal is out of the limits or in collision; `control` is the smoothest path to it
  NSVCD_PLAN_GOAL
} nsvcd_plan_status;

// The status in a word or two, for people; never NULL.
NSVCDDEF const char *nsvcd_plan_status_string(nsvcd_plan_status status);

// How far a plan has come.
typedef struct nsvcd_plan_progress {
  // the number of the initial trajectory, and of the stage's iteration with it, from 0
  size_t seed, iteration;
  // how many iterations this stage has. L-BFGS starts again if the proof finds a hit
  size_t iterations;
  // 0: MPPI, 1: L-BFGS
  int refining;
  // cost of the best trajectory of this stage. Stages evaluate different poses, so their costs do
  // not compare
  float cost;
  // the part of the cost due to collision; 0: free, as far as the stage's segments show
  float collision;
  // (via_points + 2, F) the best trajectory, valid during the call
  const float *control;
  // M
  size_t via_points;
} nsvcd_plan_progress;

// A scene: how bodies move, and which pairs can meet. No other pairs are checked. All callbacks get
// the same `user`, and must depend on nothing but that and their arguments. Joints are in radians
// or metres.
typedef struct nsvcd_plan_problem {
  // F, 1..NSVCD_MAX_JOINTS
  size_t joints;
  // (F) limits of the joints
  const float *low, *high;
  // (F) joints
  const float *start, *goal;
  // (B) bodies, with latents; those in no pair may be NULL
  const nsvcd_body *const *bodies;
  // B, up to 65536
  size_t body_count;
  // (P) pairs of indices of bodies. The planner asks about a's motion as seen from b. Let b be the
  // body that rests, or else the larger: the other way round is a little less accurate
  const nsvcd_body_pair *pairs;
  // P
  size_t pair_count;
  // computes the poses (B) of the bodies in the world, for joints (F). To grasp a thing, let this
  // move it with the hand; nothing is encoded again
  void (*kinematics)(void *user, const float *joints, nsvcd_pose *poses);
  // computes the jacobian (B, 6, F) for joints (F): for each body and joint, the displacement of
  // the body's origin and its rotation vector, in world axes. NULL: by differences of `kinematics`
  void (*jacobian)(void *user, const float *joints, float *jacobian);
  // returns the cost of collision of poses (times, B) along the trajectory; NULL: the network's. It
  // may return as soon as the sum exceeds `limit`. It sets *collides if there is a collision.
  // Unless `gradient` is NULL, it adds the cost's derivative to it, (times, B, 6), as
  // nsvcd_sweep_gradient has it
  float (*collision)(void *user, const nsvcd_pose *poses, size_t times, float limit,
                     int *collides, float *gradient);
  // called once per iteration; may be NULL. If it returns anything but 0, the plan is cancelled
  int (*progress)(void *user, const nsvcd_plan_progress *progress);
  // passed to all of these
  void *user;
} nsvcd_plan_problem;

// One of the planner's two stages. Zero means its default, which nsvcd_plan_options tells.
typedef struct nsvcd_plan_stage {
  // M, up to NSVCD_MAX_VIA_POINTS
  size_t via_points;
  // number of segments of the trajectory, up to NSVCD_MAX_PLAN_SEGMENTS. Each is swept as one
  // motion; with `discrete`, its ends are checked
  size_t segments;
  // the most iterations, up to 100000; NSVCD_NONE: the stage is skipped
  size_t iterations;
  // number of random trajectories in an iteration of MPPI, or of gradients in a bundle of L-BFGS;
  // up to 10000
  size_t draws;
  // radians or metres: their standard deviation around the trajectory. That is at mid-motion in the
  // first iteration of MPPI, and at all via points for L-BFGS's bundle. Negative: 0
  float noise;
} nsvcd_plan_stage;

// How a plan is made. Zero means the default; negative weights count as zero. If an exact check
// finds contacts, raise sweep.network.recall, `collision` or the bodies' number of patches. If the
// status is LIMIT, raise `seeds` or explore.draws. Smoothness counts radians and metres alike: for
// paths of hundreds of metres, raise `duration` or `collision`.
typedef struct nsvcd_plan_options {
  // seed of all random numbers
  uint64_t seed;
  // the most initial trajectories, which are tried until one ends free, up to 1000; default 6
  size_t seeds;
  // MPPI; default 5 via points, 24 segments, 40 iterations, 100 draws, noise 0.3
  nsvcd_plan_stage explore;
  // L-BFGS; default 10 via points, 22 segments, 10 iterations, 10 draws, noise 0.01
  nsvcd_plan_stage refine;
  // weights of their mean squares over the motion; default 10, 2, 10
  float velocity, acceleration, jerk;
  // weight of the sum of logits over pairs and segments; default 20 (the paper's is 1)
  float collision;
  // seconds from start to goal, which only weight the terms above; default 20
  float duration;
  // logits above minus this have a cost; default 2
  float margin;
  // 1: poses are checked instead of sweeps
  int discrete;
  // segments of the last check, up to 4 NSVCD_MAX_PLAN_SEGMENTS; default 16 times those of the
  // finest stage, or that limit. Joint limits are checked between segments and at via points. Twice
  // as many segments make answer.deviation a quarter
  size_t check;
  // how questions are asked; sweep.network.recall = 0.999f keeps more distance. The search asks the
  // network. `method`, `clearance`, `slop` and the like apply to the start, the goal and the last
  // check. Not read: a, b, ask, to and to_time
  nsvcd_question sweep;
} nsvcd_plan_options;

// What was found.
typedef struct nsvcd_plan_answer {
  nsvcd_plan_status status;
  // 1: the trajectory collides, by the last check; or the start or the goal does, if the status
  // names it
  int collides;
  // a joint that leaves its limits; NSVCD_NONE: none does
  size_t joint;
  // the pair with the largest logit; NSVCD_NONE: there is none
  size_t pair;
  // the largest logit of the last check; with a custom cost of collision, that cost
  float logit;
  // time of that logit, in [0,1]
  float time;
  // metres: how far the spline deviates from the motion of the last check, through whose poses it
  // goes. It is the largest deviation of any point of a's bounding sphere, as b sees it, over all
  // pairs whose body a is given, also with a custom cost of collision. It is measured, not proven:
  // half way between two poses, where a smooth curve deviates most, at 16 or more times in each
  // piece of the spline. 0: no trajectory was sought
  float deviation;
  // cost of the trajectory, and the part of it that is due to neither collision nor limits; 0: no
  // trajectory was sought
  float cost, smoothness;
  // M of `control`
  size_t via_points;
  // number of initial trajectories that were used, and of iterations of both stages
  size_t seeds, iterations;
  // number of trajectories whose cost was computed
  size_t trajectories;
  // number of queries asked
  size_t sweeps;
} nsvcd_plan_answer;

// Bytes of workspace that nsvcd_plan needs; 0 if problem or options are refused, or if it would be
// more than SIZE_MAX.
//   problem    not NULL
//   options    NULL: the defaults
NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options);

// Finds a smooth trajectory from start to goal on which no pair meets. The same problem gives the
// same trajectory, in one build: see DETERMINISM above.
//   problem    not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_plan_workspace_size(problem, options) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   control    (M + 2, F) radians or metres, not NULL; M is that of options.refine, or of explore
//              if refine is skipped. NSVCD_MAX_VIA_POINTS + 2 rows are always enough. It is written
//              whatever the status, but not on failure
//   answer     not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; bodies may be shared
//   errors     ARGUMENT (NULL), COUNT, PAIR, BODY, VERSION, STAGE, PLAN (of the options), LIMITS
//              (low above high), VALUE (limits, start or goal not finite or beyond
//              NSVCD_MAX_COORDINATE), NUMBER (a cost beyond the range of float), POSE and
//              QUATERNION (from `kinematics`), WORKSPACE, TOO_LARGE, and those of the queries
//   source     MPPI (Williams et al. 2017), then L-BFGS with bundled gradients (Suh et al. 2022);
//              NeuralSVCD, appendix D
//
// If bodies have triangles, the start, the goal and the final trajectory are proven free. The proof
// is about the motion of each pair, as seen from b, between the poses of the check's segments, with
// linear positions and slerped rotations. The spline goes through these poses, and deviates from
// that motion in between by answer.deviation, which is measured, not proven. To clear the spline
// itself, ask for a larger sweep.clearance than that. With `discrete`, or a custom cost of
// collision, nothing is proven between the poses.
//
// If the proof finds a hit, the refinement goes on from there with twice the margin and a little
// more, three times at most. The planner ends within seeds * (iterations of MPPI + 4 times those of
// L-BFGS) iterations of `draws` trajectories each, and 5 more each for L-BFGS.
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
// Made from the files of src/, which are to be edited in its place: CONTRIBUTING.md has a map, and
// says where to go for a change.
//
// CONTENTS: a room's name ends a line of dashes. Each uses only those above it.
//   interface: what a program sees
//     options         the version, and what is compiled
//     results         result codes, the caller's allocator
//     meshes          OBJ and STL, faces, parts of a mesh
//     bodies          encoding, loading, scaling, facts
//     queries         movers, questions, answers; nsvcd_sweep and its kin
//     plans           splines, planning problems; nsvcd_plan
//   ground: numbers and memory
//     compiler        what is asked of the compiler; libc and libm
//     strings         the texts of codes and statuses
//     angles          sines and angles, by libm or computed here
//     bits            bits and sizes
//     valid           checks of what a caller passes
//     points          vectors of three, of floats and of doubles
//     rotations       quaternions and matrices, of floats and of doubles
//     motions         between two poses: lines and slerps, in double
//     triangles       two triangles: where they meet, or are nearest
//     spheres         spheres and slabs, as bodies store them
//     random          random numbers
//     memory          the allocator; the rows of a workspace
//     slices          how many of 16 lanes a register holds
//   mesh: files and triangles
//     mesh            checks; cuts at a box
//     weld            vertices at the same position
//     polygons        one face into triangles
//     faces           faces of any number of corners into a mesh
//     text            tokens and numbers of a text, metres
//     obj             Wavefront OBJ
//     stl             STL, binary and text
//     files           either, with an origin and a scale
//   patches: the surface divided in parts
//     samples         oriented points of the surface, in proportion to area
//     clusters        farthest point sampling, then Lloyd's algorithm
//     covering        balls that cover the surface; patches as a whole
//     topology        welded vertices, components, which of them are closed
//     edges           which triangles share an edge; corners that are joined
//     solids          what still encloses something despite its flaws
//     regions         a large mesh in regions, each with its own patches
//   surface: the shape of each patch, bounded
//     pieces          triangles cut by the cells of the centres
//     runs            points, segments and triangles, in runs of neighbours
//     balls           the smallest ball around points
//     slabs           a direction in which points are thin
//     hulls           up to 16 vertices around a patch
//     sorted          pieces by patch; eight extremes of each, for the network
//     surface         of each patch a ball, a slab, a hull, its triangles
//   encoder: what the network keeps of a patch
//     model           does weights.h fit?
//     encoder         a patch -> its latent
//   body: the blob
//     body            balls in groups of 16, and levels of spheres above
//     traversal       the groups whose spheres pass a test
//     geometry        what the proof reads: slabs, hulls, triangles
//     trust           is a blob sound? load it, scale it, describe it
//     write           a surface -> what the proof reads
//     encode          nsvcd_encode
//     shapes          spheres, capsules, boxes, clouds
//   motion: where bodies are, and the memory of their search
//     motion          the moving body's poses as the fixed one sees them
//     workspace       the memory of a search: segments, chords, tiles, candidates
//     choice          how a motion is cut into segments, a long one into intervals
//   proof: the theorem, and its state
//     schedule        what a proof may take, and how much of it
//     proof           the theorem; what a proof is asked, knows and remembers
//   task: a question, and what it needs
//     facts           what a decoder sees of a pair; the tape of its derivative
//     task            a question that has been checked, and its memory
//   lanes: 16 numbers at a time
//     lanes           AVX-512, AVX2, SSE2, NEON, SIMD128 or plain C
//     turns           rotations, lane by lane
//   segments: 16 parts of a motion
//     segments        chords, and how far a point deviates from them
//     chords          spheres on chords, and which others they meet
//     self_test       are these vectors right?
//   search: which patches may meet
//     planes          patches that a plane between their extremes separates
//     intervals       when the balls of two patches meet, for the network
//     search          which groups and patches meet, and in which segments
//   triangles: two triangles over an interval, in double
//     poses           poses in double
//     motion_bounds   an interval of time, and how far points deviate in it
//     triangle_pairs  two triangles, in double: separated, or in contact
//     touches         how deep triangles that touch are, and what undoes it
//     manifold        contact points, the farthest along directions
//   separate: until when surfaces stay apart
//     slabs           planes along the slabs of patches and of groups
//     hulls           planes between hulls
//     blocks          16 triangles at a time
//     witnesses       two triangles that meet at one time
//     patch_pairs     two patches: separated, or in contact
//     containment     whether one body is inside the other, by rays
//     loop            every patch pair that a search finds is resolved
//     distance_bound  a distance that two vertices have: the first bound
//   network: an opinion
//     latent_rotation Wigner matrices; latents rotated by them
//     winding_number  whether one body is inside the other, estimated
//     pairs           candidates -> pairs of patches, and how they move
//     invariants      pairs -> invariants, the inputs of the decoder
//     decoder         invariants -> logits and distances, in float or int8
//     opinion         candidates, ranked, and a logit for the best of them
//     tape            what the derivative of that is made of
//   entry: the kernels of each set, and the best ones
//     processor       SSE2, AVX2 or AVX-512: the processor decides
//   gradient: of distance or logit, by poses
//     by_pair         by the decoder's inputs, and by the pair
//     gradient        by the poses, and by the times of contact
//   query: a question, and its answer
//     verdict         of one search: do they meet, when first, how near
//     long            the same of a motion of any length
//     leave           pushing out of a contact, and how deep it is
//     normals         a contact's normal, against the motion
//     supports        up to four contact points: where to seek them, and which
//     by_proof        an answer by proof
//     question        check, choose who moves, lay out the workspace, answer
//   plan: a motion that hits nothing
//     spline          quintic Hermite
//     problem         a planning problem in the caller's workspace
//     culling         which bodies may meet when; what a collision costs
//     cost            control points -> cost, and its derivative
//     explore         MPPI
//     refine          L-BFGS, with bundled gradients
//     plan            several seeds, and the last check
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

// --------------------------------------------------------------------------------- ground/compiler
#ifndef NSVCD__HAS_GROUND_COMPILER
#define NSVCD__HAS_GROUND_COMPILER
// In: the compiler at hand. Out: libc and libm, and how functions are inlined.

#ifdef __TINYC__  // 0.9.27: if a struct and a float, both returned by calls, are passed together
#error "neuralsvcd.h: tcc passes arguments wrongly, and certificates would be false"
#endif
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifndef NSVCD_NO_STDIO
#include <stdio.h>
#endif
// NSVCD_ONE_PATH: nothing may be fused or computed more exactly than it is written.
#ifdef NSVCD_ONE_PATH
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16)
#error \
    "neuralsvcd.h: NSVCD_ONE_PATH: not with -ffast-math, nor where floats are computed in double"
#endif
// gcc has a flag for that, and a pragma that slows everything down tenfold.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif
#endif
// For functions in which sums and differences of products stand side by side: there gcc 12 fuses
// whatever it is told (vfmaddsub).
#if defined(NSVCD_ONE_PATH) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNFUSED \
  static __attribute__((noinline, unused, optimize("no-tree-slp-vectorize")))
#else
#define NSVCD__UNFUSED static inline
#endif
// For functions that take less stack and flash if they are inlined.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__FORCE_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define NSVCD__FORCE_INLINE static __forceinline
#else
#define NSVCD__FORCE_INLINE static inline
#endif
// For functions whose loops over constant arguments must be unrolled. Left to itself, gcc may not
// inline them, and the decoder takes four times as long (tests/bench/PERFORMANCE.md).
#ifdef __OPTIMIZE_SIZE__
#define NSVCD__INLINE static inline
#else
#define NSVCD__INLINE NSVCD__FORCE_INLINE
#endif
// For functions whose stack would add up in a caller.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__NOINLINE __attribute__((noinline))
#elif defined(_MSC_VER)
#define NSVCD__NOINLINE __declspec(noinline)
#else
#define NSVCD__NOINLINE
#endif
#if defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNROLL _Pragma("GCC unroll 8")  // at -O2 too, so that sums stay in registers
#define NSVCD__O3 __attribute__((optimize("O3")))  // short loops, that -O2 leaves as they are
#else
#define NSVCD__UNROLL
#define NSVCD__O3
#endif
#endif  // NSVCD__HAS_GROUND_COMPILER

// ---------------------------------------------------------------------------------- ground/strings
// In: a code, a verdict or a status. Out: what it says, in English.

// Text n of several in a row, in the order of enumerators; the last if n is too large. No table of
// pointers: a loader would have to write into that.
static const char *nsvcd__text_of(const char *texts, size_t n) {
  for (; n > 0 && texts[strlen(texts) + 1]; n--) texts += strlen(texts) + 1;
  return texts;
}

static const char nsvcd__result_texts[] =
    "ok\0"
    "a pointer is NULL that must not be: an argument, or a body or an array in one\0"
    "the file is missing or cannot be read\0"
    "out of memory\0"
    "the memory given is NULL, misaligned, or too small: its size or capacity\0"
    "cancelled\0"
    "a count is 0, or larger than the library takes: joint_count, joints, part_count, "
    "body_count, goal_count or guess_count\0"
    "the file is of another format than is read here, or is cut short\0"
    "a line cannot be understood, or a face has fewer than three corners\0"
    "an index is zero or refers to no vertex\0"
    "a coordinate is not finite, or beyond a million metres\0"
    "there is no triangle, or no area, or the mesh is smaller than 1e-12 metres\0"
    "more vertices, triangles or bytes than can be counted\0"
    "sizes: a face has fewer than three corners, or all together not corner_count\0"
    "low or high is not finite, or low is not less than high on each axis\0"
    "patches is more than 65536, or patch_radius is negative or not finite\0"
    "radius, convex_radius or half is negative, wrongly zero, not finite or too large\0"
    "this is not a body: its first bytes are others, or it is damaged, "
    "cut short or misaligned\0"
    "the body is of another version, model or byte order: encode the mesh again\0"
    "a body holds no triangles, which a proof needs: encode it without no_triangles\0"
    "a body holds no latents, which the network needs: encode it with latents, "
    "and without convex_radius\0"
    "poses and count do not agree: count is 0 where poses is NULL, else 1 to 65536\0"
    "times do not rise, or, of poses, not from 0 to 1 by 1e-7 or more\0"
    "the position of a pose is not finite, or beyond a million metres\0"
    "a quaternion (x y z w) is not of unit length, to 1e-4\0"
    "a scale is not finite, negative or out of range, "
    "or makes a body too small or too large\0"
    "a pivot is not finite or too large, or is set for a certificate\0"
    "both sides are the same body in the same motion\0"
    "ask is none of its values\0"
    "method is none of its values, or cannot answer this: the network knows no FIRST, "
    "to, clearance or slop, and no proof has a gradient\0"
    "to is negative, not finite or beyond a million metres, or set where HIT is asked, "
    "which has no use for it\0"
    "to_time is not in 0 to 1, or set where FIRST is not asked\0"
    "clearance is negative, not finite or too large\0"
    "slop is negative, not finite or too large, or set for a certificate, "
    "which knows none\0"
    "tolerance is negative, not finite or beyond a million metres\0"
    "manifold is set where FIRST is not asked\0"
    "segments is not a multiple of 16 up to 64\0"
    "network.pairs is more than 256\0"
    "network.model is none of its values, or not compiled in\0"
    "network.precision is none of its values, or not compiled in\0"
    "network.recall is none of 0, 0.99, 0.999 and 0.9999\0"
    "network.inflate is negative or not finite\0"
    "a joint's kind is none of its values, or its parent does not come before it\0"
    "a joint's axis has no length, or is not finite\0"
    "a joint's limits are not finite or too large, or low is above high\0"
    "a joint's speed or acceleration is negative, not finite or too large\0"
    "a link is no joint of the scene, or a part none of its parts\0"
    "a pair is not there, or names a part that is not there, one twice, "
    "or two of one link\0"
    "a joint's value (start, goal, guess, points) is not finite or too large\0"
    "degree is not 1 to 5, or pieces are more than can be counted\0"
    "joints turn too far in a piece of the motion to be certified\0"
    "finest is negative or not finite\0"
    "max_distance or max_depth is negative, not finite or too large\0"
    "farthest is negative, not finite or too large\0"
    "nodes or shortcuts is too large, or edge is negative or no number\0"
    "explore or refine: via_points, segments, iterations, "
    "draws or noise is out of range\0"
    "velocity, acceleration, jerk, collision, duration or margin is not finite, "
    "or seeds or check too large\0"
    "this build computes wrongly: see the compiler, and its flags\0"
    "unknown result\0";

NSVCDDEF const char *nsvcd_result_string(nsvcd_result result) {
  return nsvcd__text_of(nsvcd__result_texts, (size_t)result);
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
#ifndef NSVCD__HAS_GROUND_ANGLES
#define NSVCD__HAS_GROUND_ANGLES
// In: angles up to a quarter turn, and lengths. Out: sines, and angles. By libm; with
// NSVCD_ONE_PATH computed here, because libm's last digit differs between machines.

#ifdef NSVCD_ONE_PATH
// sin x for 0 <= x <= pi / 2, to 1e-15: the rest of the series is below 2e-18.
static inline double nsvcd__sin(double x) {
  const double square = x * x;
  double sum = 1;
  for (int n = 20; n > 0; n -= 2) sum = 1 - sum * (square / (n * (n + 1)));
  return x * sum;
}
// The angle of a vector (x, y), x, y >= 0, to 1e-15. tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a))
// halves it twice, to below 0.2, where the rest of the series is below 1e-18.
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
// For 0 <= x < 1.
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
#endif  // NSVCD__HAS_GROUND_ANGLES

// ------------------------------------------------------------------------------------- ground/bits
#ifndef NSVCD__HAS_GROUND_BITS
#define NSVCD__HAS_GROUND_BITS
// In: whole numbers, and floats. Out: bits that are set, sizes rounded up, floats as bits.

// The index of the lowest bit that is set, of a number that is not 0.
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

// |x| as bits, which are ordered as |x| is; infinity and NaN are above all numbers.
static uint32_t nsvcd__magnitude(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits & 0x7fffffffu;
}
static inline int nsvcd__is_finite(float x) {
  return nsvcd__magnitude(x) < 0x7f800000u;
}
#endif  // NSVCD__HAS_GROUND_BITS

// ------------------------------------------------------------------------------------ ground/valid
#ifndef NSVCD__HAS_GROUND_VALID
#define NSVCD__HAS_GROUND_VALID
// In: what a caller passes. Out: is it valid?

#define NSVCD__MAX_COUNT 0x7fffffffu  // vertices and triangles: 2^31 - 1

static int nsvcd__is_aligned(const void *memory) {
  return ((uintptr_t)memory & (NSVCD_ALIGNMENT - 1)) == 0;
}

// Are numbers finite, and their absolute values at most `most`? By their bits, so that it holds
// under -ffast-math too.
static NSVCD__NOINLINE int nsvcd__in_range(const float *values, size_t count, float most) {
  for (size_t i = 0; i < count; i++) {
    if (!nsvcd__is_finite(values[i]) || fabsf(values[i]) > most) return 0;
  }
  return 1;
}

// A float that is not less than x >= 0.
static inline float nsvcd__above(double x) {
  return (float)(x * (1 + 2e-7)) + 1e-37f;
}

// Is it a valid length, or 0?
static int nsvcd__is_length(float x) {
  return nsvcd__is_finite(x) && x >= 0 && x <= NSVCD_MAX_COORDINATE;
}

// Are all numbers in range and all quaternions of unit length?
static nsvcd_result nsvcd__poses_check(const nsvcd_pose *poses, size_t count) {
  const float *numbers = poses->position;  // 7 to a pose
  uint32_t most = 0;
  float shortest = 1;
  float longest = 1;
  for (size_t k = 0; k < 7 * count; k++) {
    const uint32_t bits = nsvcd__magnitude(numbers[k]);
    most = bits > most ? bits : most;
  }
  for (size_t k = 0; k < count; k++) {
    const float *q = poses[k].rotation;
    const float square = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]);
    shortest = square < shortest ? square : shortest;
    longest = square > longest ? square : longest;
  }
  const int is_unit =
      shortest >= 1 - 2 * NSVCD_UNIT_TOLERANCE && longest <= 1 + 2 * NSVCD_UNIT_TOLERANCE;
  if (is_unit && most <= nsvcd__magnitude(NSVCD_MAX_COORDINATE)) return NSVCD_OK;
  for (size_t k = 0; k < count; k++) {
    if (!nsvcd__in_range(poses[k].position, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_POSE;
  }
  return NSVCD_ERROR_QUATERNION;
}

// Do times rise from 0 to 1, if there are any?
static int nsvcd__times_are_valid(const float *times, size_t count) {
  if (!times || count == 1) return 1;
  const float last = times[count - 1];
  int rise = !(times[0] < 0) && !(times[0] > 0) && last <= 1 && last >= 1;
  for (size_t k = 1; k < count; k++)  // NaN does not rise
    rise &= (double)times[k] - (double)times[k - 1] >= 0.99e-7;
  return rise;
}

// The pose of a mover without poses.
static const nsvcd_pose nsvcd__at_origin = {{0, 0, 0}, {0, 0, 0, 1}};

// A mover's scale; the default is 1.
static float nsvcd__scale_of(const nsvcd_mover *mover) {
  return mover->scale > 0 ? mover->scale : 1;
}

static size_t nsvcd__pose_count(const nsvcd_mover *mover) {
  return mover->poses ? mover->count : 1;
}

static nsvcd_result nsvcd__track_check(const nsvcd_mover *mover) {
  const float scale = nsvcd__scale_of(mover);
  const float most = NSVCD_MAX_COORDINATE / (scale > 1 ? scale : 1);
  if (!nsvcd__in_range(mover->pivot, 3, most)) return NSVCD_ERROR_PIVOT;
  if (!mover->poses) return mover->count == 0 ? NSVCD_OK : NSVCD_ERROR_POSES;
  if (mover->count < 1 || mover->count > NSVCD_MAX_POSES) return NSVCD_ERROR_POSES;
  if (!nsvcd__times_are_valid(mover->times, mover->count)) return NSVCD_ERROR_TIMES;
  return nsvcd__poses_check(mover->poses, mover->count);
}

// A mesh may come from anywhere: all that follows relies on these checks.
static inline nsvcd_result nsvcd__mesh_check(const nsvcd_mesh *mesh) {
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
  if (!nsvcd__in_range(mesh->positions, 3 * vertices, NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  return NSVCD_OK;
}
#endif  // NSVCD__HAS_GROUND_VALID

// ----------------------------------------------------------------------------------- ground/points
#ifndef NSVCD__HAS_GROUND_POINTS
#define NSVCD__HAS_GROUND_POINTS
// In, out: vectors of three numbers, as values: f3 of floats, d3 of doubles. A box is two corners.

// The greater, or the lesser, of two; b if one is NaN. fmax and fmin, which handle NaN, are calls
// with most compilers.
static inline double nsvcd__max(double a, double b) {
  return a > b ? a : b;
}
static inline double nsvcd__min(double a, double b) {
  return a < b ? a : b;
}

// The algebra of f3 and of d3: NSVCD__VECTORS(nsvcd__f3, float, sqrtf) writes nsvcd__f3_add and so
// on. _load and _row read floats, three to a row; _fma(s, b, a) is s b + a, rounded twice. In
// double, differences of floats and what is built of a few of them are practically exact.
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
  static inline scalar t##_norm(t a) { \
    return sqrt(t##_dot(a, a)); \
  }
NSVCD__VECTORS(nsvcd__f3, float, sqrtf)
NSVCD__VECTORS(nsvcd__d3, double, sqrt)
#undef NSVCD__VECTORS

// ---- floats

// From, and to, rows of x, y and z, `stride` apart.
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
// Is any component of a greater than b's?
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
// The axis of the greatest component; of equals the first.
static inline size_t nsvcd__d3_longest(nsvcd__d3 a) {
  if (a.y > a.x && a.y >= a.z) return 1;
  return a.z > a.x ? 2 : 0;
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
// Of length 1; `otherwise` if a is 0.
static inline nsvcd__d3 nsvcd__d3_unit(nsvcd__d3 a, nsvcd__d3 otherwise) {
  const double length = nsvcd__d3_norm(a);
  return length > 0 ? nsvcd__d3_scale(a, 1 / length) : otherwise;
}
// Rounds for certain. gcc 12 at -O2 drops both conversions where two neighbouring doubles become
// floats and doubles again, and a proof built on the stored floats would not hold. clang 14 for
// WebAssembly, in turn, reads a volatile number that fills a vector a second time, when it may have
// been overwritten.
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
// Rounded to double where registers are wider (x87), so that it equals itself computed again.
static inline double nsvcd__stored(double x) {
#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1
  return x;
#else
  volatile double rounded = x;
  return rounded;
#endif
}
static inline nsvcd__d3 nsvcd__d3_stored(nsvcd__d3 a) {
  return nsvcd__d3_of(nsvcd__stored(a.x), nsvcd__stored(a.y), nsvcd__stored(a.z));
}
#endif  // NSVCD__HAS_GROUND_POINTS

// -------------------------------------------------------------------------------- ground/rotations
#ifndef NSVCD__HAS_GROUND_ROTATIONS
#define NSVCD__HAS_GROUND_ROTATIONS
// In, out: rotations, as values: quat and mat3 of floats, dquat and dmat3 of doubles. A matrix is
// its rows. A transform is a rotation and a position.

// The algebra of both: NSVCD__ROTATIONS writes nsvcd__quat_dot, nsvcd__mat3_apply and so on.
//   _fma(s, b, a)        s b + a
//   _axis, _inverse      of a unit quaternion; the axis times the sine of half its angle
//   _mul(a, b)           the rotation by b, then by a
//   _turn(a, b)          from a to b, both unit: the axis, times the sine of half the angle
//   _along(a, b, arc, u) the slerp from a to b, which are that arc apart, at fraction u: of any
//                        length. Up to the arc `least` a line is as good, to rounding
//   _of                  the matrix of a unit quaternion
//   _apply_transpose     the transpose of m, times a
//   _transform           rotation a + position
#define NSVCD__ROTATIONS(quat, mat, placed, vec, scalar, sqrt, sin, least) \
  typedef struct quat { \
    scalar x, y, z, w; \
  } quat; \
  typedef struct mat { \
    vec x, y, z; \
  } mat; \
  typedef struct placed { \
    mat rotation; \
    vec position; \
  } placed; \
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
  NSVCD__FORCE_INLINE quat quat##_unit(quat q) { \
    return quat##_scale(q, 1 / sqrt(quat##_dot(q, q))); \
  } \
  static inline vec quat##_axis(quat q) { \
    return vec##_of(q.x, q.y, q.z); \
  } \
  static inline quat quat##_inverse(quat q) { \
    const quat out = {-q.x, -q.y, -q.z, q.w}; \
    return out; \
  } \
  static inline quat quat##_mul(quat a, quat b) { \
    quat out; \
    out.x = a.w * b.x + a.x * b.w + (a.y * b.z - a.z * b.y); \
    out.y = a.w * b.y + a.y * b.w + (a.z * b.x - a.x * b.z); \
    out.z = a.w * b.z + a.z * b.w + (a.x * b.y - a.y * b.x); \
    out.w = a.w * b.w - (a.x * b.x + a.y * b.y + a.z * b.z); \
    return out; \
  } \
  static inline vec quat##_turn(quat a, quat b) { \
    return quat##_axis(quat##_mul(b, quat##_inverse(a))); \
  } \
  static inline quat quat##_along(quat a, quat b, scalar arc, scalar u) { \
    const int bends = arc > least; \
    const scalar before = bends ? sin((1 - u) * arc) : 1 - u; \
    const scalar after = bends ? sin(u * arc) : u; \
    return quat##_fma(after, b, quat##_scale(a, before)); \
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
  } \
  static inline vec vec##_transform(const placed *t, vec a) { \
    return vec##_add(mat##_apply(&t->rotation, a), t->position); \
  }
NSVCD__ROTATIONS(nsvcd__quat, nsvcd__mat3, nsvcd__transform, nsvcd__f3, float, sqrtf,
                 nsvcd__sinf, 1e-3f)
NSVCD__ROTATIONS(nsvcd__dquat, nsvcd__dmat3, nsvcd__dtransform, nsvcd__d3, double, sqrt,
                 nsvcd__sin, 1e-7)
#undef NSVCD__ROTATIONS

static inline nsvcd__dmat3 nsvcd__dmat3_scale(const nsvcd__dmat3 *m, double s) {
  const nsvcd__dmat3 out = {nsvcd__d3_scale(m->x, s), nsvcd__d3_scale(m->y, s),
                            nsvcd__d3_scale(m->z, s)};
  return out;
}

// ---- quaternions and matrices of floats

static inline nsvcd__quat nsvcd__quat_of(float x, float y, float z, float w) {
  const nsvcd__quat out = {x, y, z, w};
  return out;
}
static inline nsvcd__quat nsvcd__quat_load(const float *p) {
  return nsvcd__quat_of(p[0], p[1], p[2], p[3]);
}
// To rows of x, y, z and w, `stride` apart.
static inline void nsvcd__quat_put(nsvcd__quat q, float *rows, size_t stride) {
  rows[0] = q.x;
  rows[stride] = q.y;
  rows[2 * stride] = q.z;
  rows[3 * stride] = q.w;
}
static inline void nsvcd__quat_store(nsvcd__quat q, float *p) {
  nsvcd__quat_put(q, p, 1);
}

// Is the shorter arc from a to b the one to -b? Products of floats are exact in double, so every
// machine agrees, and so do poses in float and in double, even if both arcs are equally long to
// rounding.
static inline int nsvcd__quats_opposed(nsvcd__quat a, nsvcd__quat b) {
  double dot = (double)a.x * (double)b.x;
  dot = nsvcd__stored(dot + (double)a.y * (double)b.y);
  dot = nsvcd__stored(dot + (double)a.z * (double)b.z);
  dot = nsvcd__stored(dot + (double)a.w * (double)b.w);
  return dot < 0;
}

// The length of the arc from a to b in quaternion space: half the angle of rotation, in [0, pi/2]
// for the shorter arc. From the chord, because acos of a dot product near 1 has no digits left.
static inline float nsvcd__quat_arc(nsvcd__quat a, nsvcd__quat b) {
  const nsvcd__quat chord = nsvcd__quat_fma(-1, b, a);
  return 2 * nsvcd__asinf(0.5f * sqrtf(nsvcd__quat_dot(chord, chord)));
}

// The same rotation, negated if it is opposed to another quaternion.
static inline nsvcd__quat nsvcd__quat_beside(nsvcd__quat q, int opposed) {
  return opposed ? nsvcd__quat_of(-q.x, -q.y, -q.z, -q.w) : q;
}

// From a at u = 0 to b at u = 1, on the shorter arc. a, b: unit to 1e-4.
static inline nsvcd__quat nsvcd__quat_slerp(nsvcd__quat a, nsvcd__quat b, float u) {
  const int opposed = nsvcd__quats_opposed(a, b);
  const nsvcd__quat start = nsvcd__quat_unit(a);
  const nsvcd__quat end = nsvcd__quat_beside(nsvcd__quat_unit(b), opposed);
  const float arc = nsvcd__quat_arc(start, end);
  return nsvcd__quat_unit(nsvcd__quat_along(start, end, arc, u));
}

// s (a + t b).
static inline nsvcd__mat3 nsvcd__mat3_mix(float s, const nsvcd__mat3 *a, float t,
                                          const nsvcd__mat3 *b) {
  const nsvcd__mat3 out = {nsvcd__f3_scale(nsvcd__f3_fma(t, b->x, a->x), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->y, a->y), s),
                           nsvcd__f3_scale(nsvcd__f3_fma(t, b->z, a->z), s)};
  return out;
}
#endif  // NSVCD__HAS_GROUND_ROTATIONS

// ---------------------------------------------------------------------------------- ground/motions
#ifndef NSVCD__HAS_GROUND_MOTIONS
#define NSVCD__HAS_GROUND_MOTIONS
// In: poses, as a caller gives them. Out: in double, where a body is between two of them, and how
// it turns on the way: its rotation is a slerp on the shorter arc, and the position of its pivot
// linear. With the pivot c of the body's frame, scaled, the pivot of a pose is at position + R c.
//
// This is the law of motion, for proofs, certificates and robots. The floor of motions has it again
// in float, 16 segments at a time: every query cuts its motion, and poses in double alone would
// take longer than that.

// A pose in double. Its rotation is of any length.
typedef struct nsvcd__dpose {
  nsvcd__dquat rotation;
  nsvcd__d3 position;
} nsvcd__dpose;

static inline nsvcd__dpose nsvcd__dpose_of(const nsvcd_pose *pose) {
  const float *q = pose->rotation;
  const nsvcd__dpose out = {{(double)q[0], (double)q[1], (double)q[2], (double)q[3]},
                            nsvcd__d3_load(pose->position)};
  return out;
}

// With a unit rotation.
static inline nsvcd__dpose nsvcd__unit_dpose(const nsvcd_pose *pose) {
  nsvcd__dpose out = nsvcd__dpose_of(pose);
  out.rotation = nsvcd__dquat_unit(out.rotation);
  return out;
}

static inline nsvcd__dtransform nsvcd__dtransform_of(const nsvcd__dpose *pose) {
  const nsvcd__dtransform out = {nsvcd__dmat3_of(nsvcd__dquat_unit(pose->rotation)),
                                 pose->position};
  return out;
}

static inline nsvcd_pose nsvcd__dpose_round(const nsvcd__dpose *pose) {
  const nsvcd__dquat turn = nsvcd__dquat_unit(pose->rotation);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__f3_round(pose->position), out.position);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__dquat_axis(turn)), out.rotation);
  out.rotation[3] = nsvcd__to_float(turn.w);
  return out;
}

// Is the shorter arc from a to b the one to -b?
static inline int nsvcd__poses_opposed(const nsvcd_pose *a, const nsvcd_pose *b) {
  return nsvcd__quats_opposed(nsvcd__quat_load(a->rotation), nsvcd__quat_load(b->rotation));
}

// The length of the arc from a to b, both unit, in quaternion space: half the angle of the turn.
static inline double nsvcd__dquat_arc(nsvcd__dquat a, nsvcd__dquat b) {
  const nsvcd__dquat difference = nsvcd__dquat_fma(-1, b, a);
  const nsvcd__dquat sum = nsvcd__dquat_fma(1, b, a);
  const double apart = sqrt(nsvcd__dquat_dot(difference, difference));
  return 2 * nsvcd__atan2(apart, sqrt(nsvcd__dquat_dot(sum, sum)));
}

// How a body turns from a pose to the next, or in a part of that time.
typedef struct nsvcd__slerp {
  // at the poses: unit, on the shorter side
  nsvcd__dquat start, end;
  double half_angle;  // between them as quaternions: half the angle of the turn
  // between the poses, 0 to 1: where the part begins, and its length
  double from, fraction;
} nsvcd__slerp;

// All of the turn from a to b.
static inline nsvcd__slerp nsvcd__slerp_of(const nsvcd_pose *a, const nsvcd_pose *b) {
  const double side = nsvcd__poses_opposed(a, b) ? -1 : 1;
  const nsvcd__dquat start = nsvcd__unit_dpose(a).rotation;
  const nsvcd__dquat end = nsvcd__unit_dpose(b).rotation;
  nsvcd__slerp out = {start, nsvcd__dquat_scale(end, side), 0, 0, 1};
  out.half_angle = nsvcd__dquat_arc(out.start, out.end);
  return out;
}

// The rotation at fraction u of the part, unit.
static inline nsvcd__dquat nsvcd__slerp_at(const nsvcd__slerp *s, double u) {
  const double along = s->from + s->fraction * u;
  return nsvcd__dquat_unit(nsvcd__dquat_along(s->start, s->end, s->half_angle, along));
}

// The rotation vector of the part. Points bend off their chords by an eighth of its square, per
// metre from its axis: a turn by h at a constant rate about a moves a point y with a second
// derivative of h^2 a x (a x y), by the fraction of the turn that has gone by. Along a direction n
// that is h^2 (n x a).(a x y).
static inline nsvcd__d3 nsvcd__slerp_turn(const nsvcd__slerp *slerp) {
  const nsvcd__d3 axis = nsvcd__dquat_turn(slerp->start, slerp->end);
  const double sine = nsvcd__d3_norm(axis);
  const double angle = 2 * slerp->half_angle * slerp->fraction;
  return nsvcd__d3_scale(axis, sine > 0 ? angle / sine : 0);
}

// From a pose's origin s times to its pivot c.
static inline nsvcd__d3 nsvcd__to_pivot(const nsvcd__dpose *pose, nsvcd__d3 c, double s) {
  if (!(nsvcd__d3_dot(c, c) > 0)) return pose->position;
  const nsvcd__dtransform at = nsvcd__dtransform_of(pose);
  return nsvcd__d3_transform(&at, nsvcd__d3_scale(c, s));
}

// The position of a pose's pivot c.
static inline nsvcd__d3 nsvcd__pivot_of(const nsvcd_pose *pose, nsvcd__d3 c) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  return nsvcd__to_pivot(&at, c, 1);
}

// The pose at fraction u between two, with the pivot c.
static inline nsvcd__dpose nsvcd__dpose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                nsvcd__d3 c, double u) {
  const nsvcd__slerp s = nsvcd__slerp_of(a, b);
  nsvcd__dpose out = {nsvcd__dquat_along(s.start, s.end, s.half_angle, u),
                      nsvcd__d3_mix(nsvcd__pivot_of(a, c), nsvcd__pivot_of(b, c), u)};
  out.position = nsvcd__to_pivot(&out, c, -1);
  return out;
}
#endif  // NSVCD__HAS_GROUND_MOTIONS

// -------------------------------------------------------------------------------- ground/triangles
#ifndef NSVCD__HAS_GROUND_TRIANGLES
#define NSVCD__HAS_GROUND_TRIANGLES
// In: two triangles, in double. Out: where they meet, or are nearest.

// The normal of a triangle (3 corners); its length is twice the area.
static nsvcd__d3 nsvcd__face_normal(const nsvcd__d3 *t) {
  return nsvcd__d3_cross(nsvcd__d3_sub(t[1], t[0]), nsvcd__d3_sub(t[2], t[0]));
}

typedef struct nsvcd__nearest {
  double square;  // of the distance
  nsvcd__d3 on_a, on_b;
} nsvcd__nearest;

static double nsvcd__clamp_fraction(double x) {
  return x > 0 ? (x < 1 ? x : 1) : 0;
}

static void nsvcd__keep_nearer(nsvcd__nearest *best, nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__nearest found = {nsvcd__d3_distance2(a, b), a, b};
  if (found.square < best->square) *best = found;
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
  if (determinant > 1e-14 * uu * vv)
    s = nsvcd__clamp_fraction((uv * vw - uw * vv) / determinant);
  const double t = vv > 0 ? nsvcd__clamp_fraction((uv * s + vw) / vv) : 0;
  s = uu > 0 ? nsvcd__clamp_fraction((uv * t - uw) / uu) : 0;
  nsvcd__keep_nearer(best, nsvcd__d3_mix(a0, a1, s), nsvcd__d3_mix(b0, b1, t));
}

// The foot of x on the plane of a triangle, if it is inside the triangle.
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

// Does an edge of one triangle pass through the other, and where? Heights of corners over the
// other's plane are times the length of its normal, which is not normalized.
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

// How many different corners a triangle has: 1 or 2 for a point or a segment of a round body, as
// nsvcd_encode_sphere and nsvcd_encode_capsule store it.
static size_t nsvcd__corners_of(const nsvcd__d3 *t) {
  if (nsvcd__d3_distance2(t[1], t[2]) > 0) return 3;
  return nsvcd__d3_distance2(t[0], t[1]) > 0 ? 2 : 1;
}

// The nearest points of two triangles; the distance is 0 where they meet.
static inline nsvcd__nearest nsvcd__nearest_of(const nsvcd__d3 *a, const nsvcd__d3 *b) {
  const size_t corners_a = nsvcd__corners_of(a);
  const size_t corners_b = nsvcd__corners_of(b);
  const size_t edges_a = corners_a < 3 ? 1 : 3;
  const size_t edges_b = corners_b < 3 ? 1 : 3;
  nsvcd__nearest best = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
  nsvcd__d3 point;
  if (corners_a > 1 && corners_b > 1 && nsvcd__triangles_meet(a, b, &point)) {
    const nsvcd__nearest met = {0, point, point};
    return met;
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
#endif  // NSVCD__HAS_GROUND_TRIANGLES

// ---------------------------------------------------------------------------------- ground/spheres
#ifndef NSVCD__HAS_GROUND_SPHERES
#define NSVCD__HAS_GROUND_SPHERES
// In: rows of floats, as a body stores them. Out: a sphere or a slab as a value, and constants of
// what is stored of a patch.

// The radius of padding: meets nothing, and its square is finite. A float to the last digit, for
// blobs are compared with it, also where constants are computed in double (FLT_EVAL_METHOD).
#define NSVCD__NOWHERE (-999999986991104.0f)

typedef struct nsvcd__sphere {
  nsvcd__f3 centre;
  float radius;
} nsvcd__sphere;

// Many, in arrays of x, y, z and radii.
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
// Writes sphere i into arrays of so many slots, one after the other.
static inline void nsvcd__sphere_store(nsvcd__sphere sphere, float *first, size_t slots,
                                       size_t i) {
  nsvcd__f3_put(sphere.centre, first + i, slots);
  first[3 * slots + i] = sphere.radius;
}

// ---- patches

#define NSVCD__EXTREMES 8  // points of the surface that span about all of it: surface/sorted
#define NSVCD__HULL 16     // vertices of the hull, at most

// What a stored triangle belongs to: a sheet; what is nearly a solid; a closed surface, which winds
// about what it contains; or one whose triangles face either way, so that a ray's crossings are
// counted without their sign. In the upper bits, above the triangle's number.
enum { NSVCD__SHEET, NSVCD__NEARLY, NSVCD__CLOSED, NSVCD__EITHER_DIRECTION };
#define NSVCD__KIND_SHIFT 30
#define NSVCD__NUMBER 0x3fffffffu

// ---- slabs

// Points x about a centre have low <= normal.x <= high, and are no farther than `across` from the
// line along the normal, |normal| <= 1.
typedef struct nsvcd__slab {
  nsvcd__f3 normal;
  float low, high, across;
} nsvcd__slab;

// Slab i of (6, stride).
static inline nsvcd__slab nsvcd__slab_at(const float *slabs, size_t stride, size_t i) {
  const float *d = slabs + i;
  nsvcd__slab out;
  out.normal = nsvcd__f3_get(d, stride);
  out.low = d[3 * stride];
  out.high = d[4 * stride];
  out.across = d[5 * stride];
  return out;
}
static inline void nsvcd__slab_store(nsvcd__slab slab, float *slabs, size_t stride, size_t i) {
  float *d = slabs + i;
  nsvcd__f3_put(slab.normal, d, stride);
  d[3 * stride] = slab.low;
  d[4 * stride] = slab.high;
  d[5 * stride] = slab.across;
}
#endif  // NSVCD__HAS_GROUND_SPHERES

// ----------------------------------------------------------------------------------- ground/random
#ifndef NSVCD__HAS_GROUND_RANDOM
#define NSVCD__HAS_GROUND_RANDOM
// In: a state. Out: random numbers, the same from the same state.

// Splitmix64, in (0, 1].
static inline double nsvcd__random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) * 1.1102230246251565e-16 + 5.5e-17;
}
#endif  // NSVCD__HAS_GROUND_RANDOM

// ----------------------------------------------------------------------------------- ground/memory
#ifndef NSVCD__HAS_GROUND_MEMORY
#define NSVCD__HAS_GROUND_MEMORY
// In: the caller's allocator, or a workspace. Out: arrays from either.

#ifndef NSVCD_NO_ENCODER
static void *nsvcd__alloc(const nsvcd_allocator *allocator, size_t size) {
  return allocator ? allocator->alloc(size, allocator->user) : malloc(size);
}
static void nsvcd__free(const nsvcd_allocator *allocator, void *memory) {
  if (allocator && memory) allocator->free(memory, allocator->user);
  if (!allocator) free(memory);
}
// count * size bytes; NULL also if that overflows.
static void *nsvcd__alloc_array(const nsvcd_allocator *allocator, size_t count, size_t size) {
  return count > SIZE_MAX / size ? NULL : nsvcd__alloc(allocator, count * size);
}

// Arrays that are freed together. `failed` says that there was no memory for one of them: it is
// checked once, after the last.
typedef union nsvcd__header {
  union nsvcd__header *next;
  double aligned;
} nsvcd__header;
typedef struct nsvcd__arena {
  const nsvcd_allocator *allocator;
  nsvcd__header *last;  // an array follows each
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

// Uninitialized memory for an array; NULL if there is none.
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

// Memory in place of an array (NULL: none), whose first `used` bytes it keeps; without memory the
// array stays.
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

// The next array of a workspace, or, if base is NULL, only counts its bytes: in 64 bits, because a
// 32-bit machine may not be able to address them.
static void *nsvcd__take(char *base, uint64_t *used, size_t rows, size_t row_size) {
  void *at = base ? base + *used : NULL;
  const uint64_t bytes = (uint64_t)rows * row_size;
  *used += (bytes + NSVCD_ALIGNMENT - 1) / NSVCD_ALIGNMENT * NSVCD_ALIGNMENT;
  return at;
}
#define NSVCD__TAKE_ROWS(type, rows, base, used) \
  ((type *)nsvcd__take(base, used, rows, sizeof(type)))
#endif  // NSVCD__HAS_GROUND_MEMORY

// ----------------------------------------------------------------------------------- ground/slices
// In: the compiler's flags. Out: how many of 16 lanes a register holds: a *slice*.
//
// Queries work on 16 floats at a time, a slice after the other: a function over 16 lanes loops over
// the slices, and keeps one of them in its variables. Without vectors a slice is one lane, and so
// it is with NSVCD_NO_SIMD. Instruction sets differ in rounding only: fma rounds once or twice.

#define NSVCD__LANES 16
typedef float nsvcd__row[NSVCD__LANES];  // a number in each lane

#ifndef NSVCD__ISA
// gcc on Windows does not align the stack for what is wider than 16 bytes, and programs crash: its
// bug 54412.
#if defined(_WIN32) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__NARROW
#endif
#if defined(NSVCD_NO_SIMD)
#define NSVCD__SLICE 1
#elif defined(_MSC_VER) && defined(_M_IX86) && !defined(__clang__)
#define NSVCD__SLICE 1  // cl passes no vectors by value on 32 bits: C2719
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
#ifdef NSVCD_NO_DISPATCH
#include <emmintrin.h>  // SSE2 alone: compilers take 0.2 s for all of <immintrin.h>
#else
#include <immintrin.h>
#endif
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

// The instruction sets that one build may have kernels for: entry/processor.
typedef enum nsvcd__isa { NSVCD__FLAGS, NSVCD__AVX2, NSVCD__AVX512 } nsvcd__isa;
#endif  // NSVCD__ISA

// ======================================================================= mesh: files and triangles

// --------------------------------------------------------------------------------------- mesh/mesh
// In: triangles. Out: nsvcd_mesh, every index in range, every coordinate finite; the part of one
// in a box.

#ifndef NSVCD_NO_ENCODER
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *alloc) {
  if (!mesh) return;
  nsvcd__free(alloc, mesh->positions);
  nsvcd__free(alloc, mesh->indices);
  memset(mesh, 0, sizeof *mesh);
}

// Allocates vertices and triangles. 0 without memory. Free it with nsvcd_mesh_free, on failure too.
static int nsvcd__mesh_alloc(nsvcd_mesh *mesh, size_t vertices, size_t triangles,
                             const nsvcd_allocator *alloc) {
  const size_t row = 3 * sizeof(float);
  mesh->vertex_count = vertices;
  mesh->triangle_count = triangles;
  // + 1: a file may hold faces and no vertex, and malloc(0) may return NULL.
  mesh->positions = (float *)nsvcd__alloc_array(alloc, vertices + 1, row);
  mesh->indices = (uint32_t *)nsvcd__alloc_array(alloc, triangles, row);
  return mesh->positions && mesh->indices;
}

// A triangle cut at the six sides of a box. Each side adds one corner, or two if roundings make the
// polygon cross it twice.
typedef struct nsvcd__clipped {
  nsvcd__d3 corners[3 + 2 * 6];
  size_t count;
} nsvcd__clipped;

// The part of triangle t in a box (Sutherland, Hodgman 1974): 0, or 3 to 9 corners, but for
// roundings.
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
    // keeps sign * x[axis] <= sign * bound
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
                                     const float high[3], const nsvcd_allocator *alloc,
                                     nsvcd_mesh *part) {
  if (!low || !high || !part) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 3; k++) {
    if (!nsvcd__is_finite(low[k]) || !nsvcd__is_finite(high[k]) || !(low[k] < high[k]))
      return NSVCD_ERROR_BOX;
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
  if (!nsvcd__mesh_alloc(&out, vertices, triangles, alloc)) {
    nsvcd_mesh_free(&out, alloc);
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

// --------------------------------------------------------------------------------------- mesh/weld
// In: positions of vertices. Out: for each vertex, the first one at the same position.

#ifndef NSVCD_NO_ENCODER
// A hash table of vertices by position, with open addressing.
typedef struct nsvcd__weld {
  const float *positions;
  // (slots), a power of two: numbers of vertices + 1, or 0
  uint32_t *table;
  size_t slots;
  uint64_t seed;  // of the hash
  // past other vertices
  size_t steps;
} nsvcd__weld;

// The slot of the vertex at the position of vertex v, or the empty one where it belongs.
static uint32_t *nsvcd__weld_slot(nsvcd__weld *w, size_t v) {
  const float *at = w->positions + 3 * v;
  uint64_t hash = w->seed;
  for (size_t k = 0; k < 3; k++) {
    uint32_t bits;
    memcpy(&bits, at + k, sizeof bits);
    // -0 equals 0
    if (bits == 0x80000000u) bits = 0;
    hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 32;
  }
  for (size_t slot = (size_t)hash;; slot++, w->steps++) {
    uint32_t *out = &w->table[slot & (w->slots - 1)];
    if (!*out) return out;
    const float *other = w->positions + 3 * (size_t)(*out - 1);
    if (other[0] == at[0] && other[1] == at[1] && other[2] == at[2]) return out;
  }
}

// Writes welded (count). If it takes many steps, as with vertices chosen to share a hash, it takes
// another hash. The table is zeros.
static void nsvcd__weld_vertices(nsvcd__weld *w, size_t count, uint32_t *welded) {
  for (uint32_t v = 0; v < count; v++) {
    const size_t most = 8 * (size_t)v + 1024;
    uint32_t *slot = nsvcd__weld_slot(w, v);
    if (!*slot) *slot = v + 1;
    welded[v] = *slot - 1;
    while (w->steps > most) {
      // whoever made the mesh cannot know this address
      w->seed += UINT64_C(0xd1342543de82ef95) + (uint64_t)(size_t)w->table;
      w->steps = 0;
      memset(w->table, 0, w->slots * sizeof *w->table);
      for (uint32_t u = 0; u <= v && w->steps <= most; u++)
        if (welded[u] == u) *nsvcd__weld_slot(w, u) = u + 1;
    }
  }
}

// nsvcd__weld_vertices with a table of its own. 0 without memory.
static int nsvcd__weld_all(const float *positions, size_t count, uint32_t *welded,
                           const nsvcd_allocator *alloc) {
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  nsvcd__weld w = {positions, NULL, 16, 0, 0};
  while (w.slots / 2 < count) w.slots *= 2;
  w.table = NSVCD__TAKE(&arena, uint32_t, w.slots);
  if (w.table) nsvcd__weld_vertices(&w, count, welded);
  nsvcd__arena_free(&arena);
  return !arena.failed;
}
#endif  // NSVCD_NO_ENCODER

// ----------------------------------------------------------------------------------- mesh/polygons
// In: the corners of a face. Out: triangles, by ear clipping (Meisters 1975; after Eberly,
// "Triangulation by Ear Clipping").
//
// A face of n corners becomes n - 2 triangles, whose vector areas sum to the polygon's. A simple
// polygon, concave or with holes joined to the outline by bridges, is covered without overlap; any
// other (one that crosses itself or has no area) is cut somehow.
//
// An ear is a convex corner whose triangle contains no reflex corner. Difference from Eberly: that
// test visits boxes, not all reflex corners, so that faces may have many corners. The corners are
// sorted along a Z curve (Morton 1966); each run of 8 has a box, each two neighbouring boxes have
// one about them, and so on up to one about all.

#ifndef NSVCD_NO_READERS
#define NSVCD__RUN 8

// A point in the polygon's plane.
typedef struct nsvcd__d2 {
  double x, y;
} nsvcd__d2;

typedef struct nsvcd__corner {
  // the polygon is counter-clockwise
  nsvcd__d2 at;
  uint32_t vertex;
  // in the ring of corners not yet clipped
  uint32_t previous, next;
  uint32_t queued;  // 1: in the queue
  // 1: the inner angle exceeds 180 degrees
  uint32_t reflex;
  uint32_t box;  // of its run
} nsvcd__corner;

typedef struct nsvcd__corner_box {
  nsvcd__d2 low, high;
  // how many reflex corners are in it
  uint32_t reflex;
} nsvcd__corner_box;

typedef struct nsvcd__polygon {
  nsvcd__corner *corners;
  // (count) corners along the Z curve
  uint32_t *order;
  // (2 runs) box k is about boxes 2 k and 2 k + 1; the last `runs` are those of the runs
  nsvcd__corner_box *boxes;
  // runs: a power of two
  uint32_t count, runs;
  // (count) a ring buffer: corners that may have become ears
  uint32_t *queue;
  uint32_t queue_first, queue_length;
} nsvcd__polygon;

// The number of runs, rounded up to a power of two.
static uint32_t nsvcd__runs_of(uint32_t corners) {
  uint32_t runs = 1;
  while (NSVCD__RUN * (uint64_t)runs < corners) runs *= 2;
  return runs;
}

// Makes room for polygons of up to `corners` corners. 0 without memory.
static int nsvcd__polygon_alloc(nsvcd__polygon *poly, uint32_t corners, nsvcd__arena *arena) {
  memset(poly, 0, sizeof *poly);
  poly->corners = NSVCD__TAKE(arena, nsvcd__corner, corners);
  poly->order = NSVCD__TAKE(arena, uint32_t, corners);
  poly->queue = NSVCD__TAKE(arena, uint32_t, corners);
  poly->boxes = NSVCD__TAKE(arena, nsvcd__corner_box, 2 * (size_t)nsvcd__runs_of(corners));
  return !arena->failed;
}

// Twice the area of abc, positive if counter-clockwise. Differences of floats are next to exact in
// double.
static double nsvcd__d2_cross(nsvcd__d2 a, nsvcd__d2 b, nsvcd__d2 c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}
static int nsvcd__same_position(nsvcd__d2 a, nsvcd__d2 b) {
  return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y);
}

// Projects the corners along the axis nearest to the normal, which keeps coordinates exact.
static void nsvcd__polygon_project(nsvcd__polygon *poly, const float *positions) {
  nsvcd__corner *corners = poly->corners;
  // twice the area times the normal (Newell's)
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  const nsvcd__d3 origin = nsvcd__d3_row(positions, corners[0].vertex);
  for (uint32_t i = 0; i < poly->count; i++) {
    const uint32_t next = corners[(i + 1) % poly->count].vertex;
    const nsvcd__d3 p = nsvcd__d3_sub(nsvcd__d3_row(positions, corners[i].vertex), origin);
    const nsvcd__d3 q = nsvcd__d3_sub(nsvcd__d3_row(positions, next), origin);
    normal = nsvcd__d3_add(normal, nsvcd__d3_cross(p, q));
  }
  const nsvcd__d3 size = {fabs(normal.x), fabs(normal.y), fabs(normal.z)};
  const size_t axis = nsvcd__d3_longest(size);
  const size_t turned = nsvcd__d3_axis(normal, axis) < 0;
  for (uint32_t i = 0; i < poly->count; i++) {
    const float *p = positions + 3 * (size_t)corners[i].vertex;
    corners[i].at.x = (double)p[(axis + 1 + turned) % 3];
    corners[i].at.y = (double)p[(axis + 2 - turned) % 3];
  }
}

// Sorts corners along the Z curve by this bit of their keys and those below: x and y take turns.
static void nsvcd__z_sort(const nsvcd__corner *corners, uint32_t *order, uint32_t count,
                          int bit) {
  if (count <= NSVCD__RUN || bit < 0) return;
  // the first that has the bit
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

// Contains nothing. tcc has no HUGE_VAL in constants.
#define NSVCD__NO_BOX \
  { {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0 }

static void nsvcd__box_take(nsvcd__corner_box *box, nsvcd__d2 at) {
  if (at.x < box->low.x) box->low.x = at.x;
  if (at.y < box->low.y) box->low.y = at.y;
  if (at.x > box->high.x) box->high.x = at.x;
  if (at.y > box->high.y) box->high.y = at.y;
}

// Makes the boxes. No corner counts as reflex yet.
static void nsvcd__polygon_box(nsvcd__polygon *poly) {
  poly->runs = nsvcd__runs_of(poly->count);
  const nsvcd__corner_box none = NSVCD__NO_BOX;
  for (uint32_t k = 0; k < 2 * poly->runs; k++) poly->boxes[k] = none;
  for (uint32_t i = 0; i < poly->count; i++) poly->order[i] = i;
  nsvcd__z_sort(poly->corners, poly->order, poly->count, 63);
  for (uint32_t i = 0; i < poly->count; i++) {
    nsvcd__corner *c = &poly->corners[poly->order[i]];
    c->box = poly->runs + i / NSVCD__RUN;
    for (uint32_t k = c->box; k > 0; k /= 2) nsvcd__box_take(&poly->boxes[k], c->at);
  }
}

static void nsvcd__polygon_set_reflex(nsvcd__polygon *poly, uint32_t i, uint32_t reflex) {
  nsvcd__corner *c = &poly->corners[i];
  for (uint32_t k = c->box; k > 0 && c->reflex != reflex; k /= 2)
    poly->boxes[k].reflex += reflex - c->reflex;
  c->reflex = reflex;
}

// Updates corner i after a neighbour of it has changed.
static void nsvcd__polygon_update(nsvcd__polygon *poly, uint32_t i) {
  nsvcd__corner *corners = poly->corners;
  nsvcd__corner *c = &corners[i];
  const nsvcd__d2 previous = corners[c->previous].at;
  const nsvcd__d2 next = corners[c->next].at;
  nsvcd__polygon_set_reflex(poly, i, nsvcd__d2_cross(previous, c->at, next) < 0);
  if (c->queued) return;
  c->queued = 1;
  poly->queue[(poly->queue_first + poly->queue_length++) % poly->count] = i;
}

// A triangle of three neighbours, counter-clockwise, and the box about it.
typedef struct nsvcd__ear {
  nsvcd__d2 at[3];
  nsvcd__corner_box box;
} nsvcd__ear;

// Does an ear contain a point that is not at one of its corners?
static int nsvcd__ear_holds(const nsvcd__ear *ear, nsvcd__d2 p) {
  for (size_t k = 0; k < 3; k++) {
    if (nsvcd__d2_cross(ear->at[k], ear->at[(k + 1) % 3], p) < 0) return 0;
  }
  if (nsvcd__same_position(p, ear->at[0]) || nsvcd__same_position(p, ear->at[1])) return 0;
  return !nsvcd__same_position(p, ear->at[2]);
}

// May an ear contain a corner in a box?
static int nsvcd__ear_meets(const nsvcd__ear *ear, const nsvcd__corner_box *box) {
  if (nsvcd__same_position(box->low, box->high)) return nsvcd__ear_holds(ear, box->low);
  if (ear->box.high.x < box->low.x || ear->box.high.y < box->low.y) return 0;
  if (ear->box.low.x > box->high.x || ear->box.low.y > box->high.y) return 0;
  for (size_t k = 0; k < 3; k++) {
    // if the leftmost corner of the box is to the right of a side, all of it is
    const nsvcd__d2 a = ear->at[k];
    const nsvcd__d2 b = ear->at[(k + 1) % 3];
    const double x = b.y > a.y ? box->low.x : box->high.x;
    const nsvcd__d2 left = {x, b.x > a.x ? box->high.y : box->low.y};
    if (nsvcd__d2_cross(a, b, left) < 0) return 0;
  }
  return 1;
}

// Is corner i an ear? Only reflex corners can be in its triangle.
static int nsvcd__polygon_is_ear(const nsvcd__polygon *poly, uint32_t i) {
  const nsvcd__corner *corners = poly->corners;
  const nsvcd__d2 a = corners[corners[i].previous].at;
  const nsvcd__d2 c = corners[corners[i].next].at;
  nsvcd__ear ear = {{a, corners[i].at, c}, NSVCD__NO_BOX};
  if (nsvcd__d2_cross(a, ear.at[1], c) <= 0) return 0;
  for (size_t k = 0; k < 3; k++) nsvcd__box_take(&ear.box, ear.at[k]);
  for (uint32_t k = 1; k > 0;) {
    const nsvcd__corner_box *box = &poly->boxes[k];
    const int meets = box->reflex > 0 && nsvcd__ear_meets(&ear, box);
    if (meets && k < poly->runs) {
      k *= 2;
      continue;
    }
    const uint32_t first = NSVCD__RUN * (k - poly->runs);
    for (uint32_t j = first; meets && j < first + NSVCD__RUN && j < poly->count; j++) {
      const nsvcd__corner *p = &corners[poly->order[j]];
      if (p->reflex && nsvcd__ear_holds(&ear, p->at)) return 0;
    }
    // the next box that is not part of this one; 0: none is left
    while (k % 2) k /= 2;
    k += k > 0;
  }
  return 1;
}

// Writes triangles (count - 2, 3). poly: 3 or more corners, whose vertices are set.
static void nsvcd__polygon_triangulate(nsvcd__polygon *poly, const float *positions,
                                       uint32_t *triangles) {
  nsvcd__corner *corners = poly->corners;
  const uint32_t count = poly->count;
  poly->queue_first = 0;
  poly->queue_length = 0;
  for (uint32_t i = 0; i < count; i++) {
    corners[i].previous = (i + count - 1) % count;
    corners[i].next = (i + 1) % count;
    corners[i].queued = 0;
    corners[i].reflex = 0;
  }
  if (count > 3) {
    nsvcd__polygon_project(poly, positions);
    nsvcd__polygon_box(poly);
    for (uint32_t i = 0; i < count; i++) nsvcd__polygon_update(poly, i);
  }

  // a corner that is left
  uint32_t at = 0;
  for (uint32_t left = count; left > 3;) {
    // With an empty queue no corner is an ear, and the polygon is not simple: clip any corner.
    const int stuck = poly->queue_length == 0;
    const uint32_t i = stuck ? at : poly->queue[poly->queue_first];
    nsvcd__corner *c = &corners[i];
    if (!stuck) {
      poly->queue_first = (poly->queue_first + 1) % count;
      poly->queue_length--;
      c->queued = 0;
    }
    if (!stuck && !nsvcd__polygon_is_ear(poly, i)) continue;
    triangles[0] = corners[c->previous].vertex;
    triangles[1] = c->vertex;
    triangles[2] = corners[c->next].vertex;
    triangles += 3;
    left--;
    corners[c->previous].next = c->next;
    corners[c->next].previous = c->previous;
    nsvcd__polygon_set_reflex(poly, i, 0);
    nsvcd__polygon_update(poly, c->previous);
    nsvcd__polygon_update(poly, c->next);
    at = c->next;
  }
  triangles[0] = corners[at].vertex;
  triangles[1] = corners[corners[at].next].vertex;
  triangles[2] = corners[corners[at].previous].vertex;
}
#endif  // NSVCD_NO_READERS

// -------------------------------------------------------------------------------------- mesh/faces
// In: faces of any number of corners, from an engine or another reader. Out: nsvcd_mesh.

#ifndef NSVCD_NO_READERS
// Checks the faces. *triangles: how many they become; *most: corners of the largest.
static nsvcd_result nsvcd__faces_check(const nsvcd_faces *f, size_t *triangles,
                                       uint32_t *most) {
  size_t corners = 0;
  *triangles = 0;
  *most = 0;
  for (size_t n = 0; n < f->face_count; n++) {
    const uint32_t size = f->sizes ? f->sizes[n] : 3;
    if (size < 3 || size > f->corner_count - corners) return NSVCD_ERROR_SIZES;
    corners += size;
    *triangles += size - 2;
    if (size > *most) *most = size;
  }
  if (corners != f->corner_count) return NSVCD_ERROR_SIZES;
  if (f->vertex_count > NSVCD__MAX_COUNT || *triangles > NSVCD__MAX_COUNT)
    return NSVCD_ERROR_TOO_LARGE;
  for (size_t i = 0; i < corners; i++) {
    if (f->corners[i] >= f->vertex_count) return NSVCD_ERROR_INDEX;
  }
  if (!nsvcd__in_range(f->positions, 3 * f->vertex_count, NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  return *triangles ? NSVCD_OK : NSVCD_ERROR_EMPTY;
}

NSVCDDEF nsvcd_result nsvcd_mesh_of_faces(const nsvcd_faces *f, const nsvcd_allocator *alloc,
                                          nsvcd_mesh *mesh) {
  nsvcd_mesh out;
  nsvcd__polygon polygon;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  size_t triangles;
  uint32_t most;
  if (!f || !mesh) return NSVCD_ERROR_ARGUMENT;
  if ((f->vertex_count && !f->positions) || (f->corner_count && !f->corners))
    return NSVCD_ERROR_ARGUMENT;
  nsvcd_result result = nsvcd__faces_check(f, &triangles, &most);
  if (result) return result;
  if (!nsvcd__mesh_alloc(&out, f->vertex_count, triangles, alloc) ||
      !nsvcd__polygon_alloc(&polygon, most, &arena)) {
    nsvcd__arena_free(&arena);
    nsvcd_mesh_free(&out, alloc);
    return NSVCD_ERROR_MEMORY;
  }
  memcpy(out.positions, f->positions, 3 * f->vertex_count * sizeof(float));
  const uint32_t *corner = f->corners;
  uint32_t *triangle = out.indices;
  for (size_t n = 0; n < f->face_count; n++) {
    polygon.count = f->sizes ? f->sizes[n] : 3;
    for (uint32_t i = 0; i < polygon.count; i++) polygon.corners[i].vertex = *corner++;
    nsvcd__polygon_triangulate(&polygon, out.positions, triangle);
    triangle += 3 * (size_t)(polygon.count - 2);
  }
  nsvcd__arena_free(&arena);
  *mesh = out;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_READERS

// --------------------------------------------------------------------------------------- mesh/text
// In: the bytes of a text. Out: its tokens and numbers, one after another, and coordinates in
// metres. What the readers of mesh files share.

#ifndef NSVCD_NO_READERS
// Fills zeroed options with those given (NULL: none) and with defaults.
static nsvcd_result nsvcd__mesh_options_of(const nsvcd_mesh_options *given,
                                           nsvcd_mesh_options *out) {
  if (given) *out = *given;
  for (size_t k = 0; k < 3; k++) {
    if (!(fabs(out->origin[k]) < HUGE_VAL)) return NSVCD_ERROR_NUMBER;
  }
  if (!(out->scale >= 0 && out->scale < HUGE_VAL)) return NSVCD_ERROR_SCALE;
  if (!(out->scale > 0)) out->scale = 1;
  return NSVCD_OK;
}

// Turns a coordinate of the file into metres. The limit is on metres, not on the file's number.
static nsvcd_result nsvcd__mesh_number(const nsvcd_mesh_options *options, size_t axis,
                                       double value, float *out) {
  const double metres = (value - options->origin[axis]) * options->scale;
  if (!(fabs(metres) <= (double)NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  *out = (float)metres;
  return NSVCD_OK;
}

// A text that is being read.
typedef struct nsvcd__text {
  const char *at, *end;
  // the statement's first token, or NULL
  const char *word;
  nsvcd_mesh_options options;
  // of `at`, from 1; 0: before the first
  size_t line;
  // counted so far
  uint32_t vertices, triangles;
  uint32_t max_corners;  // of a face
} nsvcd__text;

// Length of the newline at p, or 0.
static size_t nsvcd__text_newline(const char *p, const char *end) {
  if (p == end || (*p != '\n' && *p != '\r')) return 0;
  return end - p >= 2 && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
}
// Length of the blank at p, or 0. A backslash and a newline are a blank: the statement goes on.
static inline size_t nsvcd__text_blank(const char *p, const char *end) {
  if (p == end) return 0;
  if (*p == ' ' || *p == '\t' || *p == '\v' || *p == '\f') return 1;
  if (*p != '\\') return 0;
  const size_t newline = nsvcd__text_newline(p + 1, end);
  return newline > 0 ? 1 + newline : 0;
}
static int nsvcd__text_is_digit(const nsvcd__text *t) {
  return t->at < t->end && *t->at >= '0' && *t->at <= '9';
}
static int nsvcd__text_accept(nsvcd__text *t, char c) {
  const int is_there = t->at < t->end && *t->at == c;
  if (is_there) t->at++;
  return is_there;
}
static int nsvcd__text_line_ends(const nsvcd__text *t) {
  return t->at == t->end || *t->at == '\n' || *t->at == '\r';
}
// Reads digits; returns 0 if there are none. The number saturates, above any limit.
static int nsvcd__text_integer(nsvcd__text *t, int64_t *number) {
  const char *start = t->at;
  for (*number = 0; nsvcd__text_is_digit(t); t->at++) {
    if (*number < 1000000000000000) *number = 10 * *number + (*t->at - '0');
  }
  return t->at > start;
}
static int nsvcd__text_token_ends(const nsvcd__text *t) {
  if (nsvcd__text_line_ends(t)) return 1;
  return nsvcd__text_blank(t->at, t->end) > 0;
}
static inline void nsvcd__text_skip_token(nsvcd__text *t) {
  for (; !nsvcd__text_token_ends(t); t->at++) {
    // a fast path over characters that end no token
    while (t->at + 1 < t->end && (unsigned char)t->at[1] > ' ' && t->at[1] != '\\') t->at++;
  }
}

// Skips blanks. Returns 0 at the end of the statement.
static int nsvcd__text_has_token(nsvcd__text *t) {
  size_t blank = nsvcd__text_blank(t->at, t->end);
  while (blank > 0) {
    t->line += blank > 1;
    t->at += blank;
    blank = nsvcd__text_blank(t->at, t->end);
  }
  return !nsvcd__text_line_ends(t) && *t->at != '#';
}

// mantissa * 10^exponent, exponent in -400..400. Powers up to 10^22 are exact, so there is usually
// a single rounding.
static double nsvcd__text_scale(uint64_t mantissa, int exponent) {
  static const double power[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  double value = (double)mantissa;
  for (; exponent > 22; exponent -= 22) value *= power[22];
  for (; exponent < -22; exponent += 22) value /= power[22];
  return exponent < 0 ? value / power[-exponent] : value * power[exponent];
}

// Accepts a sign; returns 1 if it is a minus.
static int nsvcd__text_minus(nsvcd__text *t) {
  const int minus = nsvcd__text_accept(t, '-');
  if (!minus) nsvcd__text_accept(t, '+');
  return minus;
}

// Reads a decimal number. Its relative error is at most 2^-52, and a few times that where the
// exponent is beyond +-22: rounded to float it is the nearest one, except for ties. NUMBER if it is
// infinite or NaN as printf writes them (nan, -nan(ind), inf, 1.#QNAN).
static nsvcd_result nsvcd__text_number(nsvcd__text *t, double *value) {
  const int negative = nsvcd__text_minus(t);
  if (t->at < t->end && strchr("nNiI", *t->at) && *t->at) return NSVCD_ERROR_NUMBER;
  // digits and a point: mantissa * 10^exponent
  uint64_t mantissa = 0;
  int64_t exponent = 0;
  int digits = 0;
  for (int point = 0;; t->at++) {
    if (!point && nsvcd__text_accept(t, '.')) point = 1;
    if (!nsvcd__text_is_digit(t)) break;
    digits = 1;
    // 19 digits are kept, the rest only move the point
    const int fits = mantissa < 1000000000000000000u;
    if (fits) mantissa = 10 * mantissa + (uint64_t)(*t->at - '0');
    exponent += !fits - point;
  }
  if (!digits) return NSVCD_ERROR_SYNTAX;
  if (t->at[-1] == '.' && nsvcd__text_accept(t, '#')) return NSVCD_ERROR_NUMBER;
  if (nsvcd__text_accept(t, 'e') || nsvcd__text_accept(t, 'E')) {
    const int minus = nsvcd__text_minus(t);
    int64_t written;
    if (!nsvcd__text_integer(t, &written)) return NSVCD_ERROR_SYNTAX;
    exponent += minus ? -written : written;
  }
  if (!nsvcd__text_token_ends(t)) return NSVCD_ERROR_SYNTAX;
  if (mantissa == 0) exponent = 0;
  if (exponent > 400) return NSVCD_ERROR_NUMBER;
  const int power = exponent < -400 ? -400 : (int)exponent;
  const double magnitude = nsvcd__text_scale(mantissa, power);
  *value = negative ? -magnitude : magnitude;
  return NSVCD_OK;
}

static void nsvcd__text_begin(nsvcd__text *t, const char *text, size_t size) {
  memset(t, 0, sizeof *t);
  t->at = text;
  t->end = text + size;
  // UTF-8 byte order mark
  if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) t->at += 3;
}
#endif  // NSVCD_NO_READERS

// ---------------------------------------------------------------------------------------- mesh/obj
// In: the text of a Wavefront OBJ file (version 3.0). Out: nsvcd_mesh. Only the statements v and f
// are used.
//
// Three passes over the text: count, vertices, faces. A face names any vertex of the file by its
// number, a later one too; negative numbers count back from the last vertex so far. The locale
// plays no part. A keyword that is skipped consists of letters, and of digits after the first two
// characters: curv2 is one, f1 is a mistake.

#ifndef NSVCD_NO_READERS
// Goes to the next statement. Skips the rest of this one token by token, so that all passes agree
// on where comments end: a backslash does not continue them. Returns the keyword: v, f, # for any
// other, ? for a word that is none, or 0 at the end of the text.
static int nsvcd__obj_next(nsvcd__text *obj) {
  if (obj->line > 0) {
    while (nsvcd__text_has_token(obj)) nsvcd__text_skip_token(obj);
    while (!nsvcd__text_line_ends(obj)) obj->at++;
    obj->at += nsvcd__text_newline(obj->at, obj->end);
  }
  obj->line++;
  obj->word = NULL;
  if (!nsvcd__text_has_token(obj)) return obj->at == obj->end ? 0 : '#';
  const char *start = obj->at;
  obj->word = start;
  nsvcd__text_skip_token(obj);
  if (obj->at - start == 1 && (*start == 'v' || *start == 'f')) return *start;
  for (const char *p = start; p < obj->at; p++) {
    const int letter = (*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || *p == '_';
    const int digit = *p >= '0' && *p <= '9';
    if (!letter && !(digit && p - start >= 2)) return '?';
  }
  return '#';
}

// Reads one corner: v, v/vt, v//vn or v/vt/vn. The numbers after a slash are neither used nor
// checked against a range, and may be missing: some files have v//. vertex_count: of the file.
static nsvcd_result nsvcd__obj_corner(nsvcd__text *obj, uint32_t vertex_count,
                                      uint32_t *vertex) {
  const int negative = nsvcd__text_accept(obj, '-');
  const uint32_t most = negative ? obj->vertices : vertex_count;
  int64_t number, unused;
  if (!nsvcd__text_integer(obj, &number)) return NSVCD_ERROR_SYNTAX;
  for (int i = 0; i < 2 && nsvcd__text_accept(obj, '/'); i++) {
    if (nsvcd__text_token_ends(obj) || (i == 0 && *obj->at == '/')) continue;
    nsvcd__text_accept(obj, '-');
    if (!nsvcd__text_integer(obj, &unused)) return NSVCD_ERROR_SYNTAX;
  }
  if (!nsvcd__text_token_ends(obj)) return NSVCD_ERROR_SYNTAX;
  if (number == 0 || number > (int64_t)most) return NSVCD_ERROR_INDEX;
  *vertex = (uint32_t)(negative ? (int64_t)most - number : number - 1);
  return NSVCD_OK;
}

// Is the statement's keyword one of OBJ's?
static int nsvcd__obj_is_own(const nsvcd__text *obj) {
  static const char words[] =
      " v vt vn vp p l f g o s mg usemtl mtllib usemap maplib "
      "cstype deg bmat step curv curv2 surf parm trim hole scrv "
      "sp end con bevel c_interp d_interp lod shadow_obj "
      "trace_obj ctech stech ";
  const size_t length = (size_t)(obj->at - obj->word);
  for (const char *word = words; *++word; word += strcspn(word, " ")) {
    if (strcspn(word, " ") == length && memcmp(word, obj->word, length) == 0) return 1;
  }
  return 0;
}

// FORMAT if the rest of the text has statements, but none of OBJ's; else `otherwise`. Sets the line
// to that of the first foreign statement. line: where one was found before, or 0.
static nsvcd_result nsvcd__obj_other(nsvcd__text *obj, size_t line, nsvcd_result otherwise) {
  int is_obj = obj->vertices > 0 || obj->triangles > 0;
  while (!is_obj && nsvcd__obj_next(obj)) {
    is_obj = obj->word && nsvcd__obj_is_own(obj);
    if (obj->word && !line) line = obj->line;
  }
  obj->line = line;
  return is_obj || !line ? otherwise : NSVCD_ERROR_FORMAT;
}

// First pass: counts vertices and triangles.
static nsvcd_result nsvcd__obj_count(nsvcd__text *obj) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword == '?') return nsvcd__obj_other(obj, obj->line, NSVCD_ERROR_SYNTAX);
    if (keyword == 'v' && obj->vertices++ == NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
    if (keyword != 'f') continue;
    size_t corners = 0;
    for (; nsvcd__text_has_token(obj); nsvcd__text_skip_token(obj)) corners++;
    if (corners < 3) return NSVCD_ERROR_SYNTAX;
    if (corners - 2 > NSVCD__MAX_COUNT - obj->triangles) return NSVCD_ERROR_TOO_LARGE;
    obj->triangles += (uint32_t)(corners - 2);
    if (corners > obj->max_corners) obj->max_corners = (uint32_t)corners;
  }
  return NSVCD_OK;
}

// Second pass: positions (vertices, 3). Up to five numbers after v x y z (a weight, a colour) are
// skipped; these may be infinite or NaN.
static nsvcd_result nsvcd__obj_vertices(nsvcd__text *obj, float *positions) {
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    if (keyword != 'v') continue;
    int count = 0;
    for (; nsvcd__text_has_token(obj); count++) {
      double value = 0;
      nsvcd_result result = nsvcd__text_number(obj, &value);
      if (count >= 3 && result == NSVCD_ERROR_NUMBER) {
        nsvcd__text_skip_token(obj);
        result = NSVCD_OK;
      }
      if (count == 8) result = NSVCD_ERROR_SYNTAX;
      if (!result && count < 3)
        result = nsvcd__mesh_number(&obj->options, (size_t)count, value, positions++);
      if (result) return result;
    }
    if (count < 3) return NSVCD_ERROR_SYNTAX;
  }
  return NSVCD_OK;
}

// Third pass: the mesh's indices. polygon: room for the largest face.
static nsvcd_result nsvcd__obj_faces(nsvcd__text *obj, const nsvcd_mesh *mesh,
                                     nsvcd__polygon *polygon) {
  uint32_t *triangles = mesh->indices;
  for (int keyword = nsvcd__obj_next(obj); keyword; keyword = nsvcd__obj_next(obj)) {
    obj->vertices += keyword == 'v';
    if (keyword != 'f') continue;
    polygon->count = 0;
    while (nsvcd__text_has_token(obj)) {
      uint32_t *vertex = &polygon->corners[polygon->count++].vertex;
      const nsvcd_result result = nsvcd__obj_corner(obj, (uint32_t)mesh->vertex_count, vertex);
      if (result) return result;
    }
    nsvcd__polygon_triangulate(polygon, mesh->positions, triangles);
    triangles += 3 * (size_t)(polygon->count - 2);
  }
  return NSVCD_OK;
}

// Reads a text from its beginning. obj->line: where it fails, or 0 if no line is at fault.
static nsvcd_result nsvcd__obj_read(nsvcd__text *obj, nsvcd__arena *arena, nsvcd_mesh *mesh) {
  const nsvcd__text begin = *obj;
  nsvcd__polygon polygon;
  nsvcd_result result = nsvcd__obj_count(obj);
  if (result) return result;
  obj->line = 0;
  if (obj->triangles == 0) {
    if (obj->vertices == 0) *obj = begin;
    result = nsvcd__obj_other(obj, 0, NSVCD_ERROR_EMPTY);
    if (result == NSVCD_ERROR_EMPTY) obj->line = 0;
    return result;
  }
  if (!nsvcd__mesh_alloc(mesh, obj->vertices, obj->triangles, arena->allocator) ||
      !nsvcd__polygon_alloc(&polygon, obj->max_corners, arena))
    return NSVCD_ERROR_MEMORY;
  *obj = begin;
  result = nsvcd__obj_vertices(obj, mesh->positions);
  if (result) return result;
  *obj = begin;
  return nsvcd__obj_faces(obj, mesh, &polygon);
}
#endif  // NSVCD_NO_READERS

// ---------------------------------------------------------------------------------------- mesh/stl
// In: an STL file, binary or text. Out: nsvcd_mesh.
//
// A file is binary if it has the size that its count of triangles says, does not begin with
// "solid", or holds a NUL, which no text does. Of a text only the words vertex and endloop matter:
// three vertices a loop.

#ifndef NSVCD_NO_READERS
#define NSVCD__STL_HEADER 84  // bytes, the count of triangles included
#define NSVCD__STL_FACET 50

static uint32_t nsvcd__stl_word(const unsigned char *p) {
  return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

// The size of a binary file with the count of triangles that this one has.
static uint64_t nsvcd__stl_size(const void *data, size_t size) {
  const unsigned char *count = (const unsigned char *)data + 80;
  const uint64_t triangles = size < NSVCD__STL_HEADER ? 0 : nsvcd__stl_word(count);
  return NSVCD__STL_HEADER + NSVCD__STL_FACET * triangles;
}

// Reads the corners (count, 3) of a binary file.
static nsvcd_result nsvcd__stl_binary(const void *data, const nsvcd_mesh_options *options,
                                      float *corners, size_t count) {
  const unsigned char *first = (const unsigned char *)data + NSVCD__STL_HEADER;
  for (size_t i = 0; i < 3 * count; i++) {
    // a facet's normal comes before its corners
    const unsigned char *at = first + NSVCD__STL_FACET * (i / 9) + 12 + 4 * (i % 9);
    const uint32_t bits = nsvcd__stl_word(at);
    float value;
    memcpy(&value, &bits, sizeof bits);
    const nsvcd_result result = nsvcd__mesh_number(options, i % 3, (double)value, &corners[i]);
    if (result) return result;
  }
  return NSVCD_OK;
}

// Goes to the next token, on whichever line; 0 at the end of the text.
static int nsvcd__stl_token(nsvcd__text *text) {
  for (;;) {
    const size_t newline = nsvcd__text_newline(text->at, text->end);
    const size_t skipped = newline ? newline : nsvcd__text_blank(text->at, text->end);
    if (!skipped) return text->at < text->end;
    text->line += newline > 0;
    text->at += skipped;
  }
}

// Passes the token if it is this word, in whatever case.
static int nsvcd__stl_accept(nsvcd__text *text, const char *word) {
  const char *p = text->at;
  for (; *word; word++, p++) {
    if (p == text->end || (*p | 32) != *word) return 0;
  }
  nsvcd__text rest = *text;
  rest.at = p;
  if (!nsvcd__text_token_ends(&rest)) return 0;
  text->at = p;
  return 1;
}

// Does a text begin with the word "solid"?
static int nsvcd__stl_is_solid(nsvcd__text text) {
  return nsvcd__stl_token(&text) && nsvcd__stl_accept(&text, "solid");
}

// Reads the corners (count, 3) of a text; NULL: only counts them.
static nsvcd_result nsvcd__stl_text(nsvcd__text *text, float *corners, size_t *count) {
  size_t in_loop = 0;
  *count = 0;
  while (nsvcd__stl_token(text)) {
    if (nsvcd__stl_accept(text, "solid") || nsvcd__stl_accept(text, "endsolid")) {
      // a name follows
      while (!nsvcd__text_line_ends(text)) text->at++;
    } else if (nsvcd__stl_accept(text, "endloop")) {
      if (in_loop != 3) return NSVCD_ERROR_SYNTAX;
      in_loop = 0;
    } else if (nsvcd__stl_accept(text, "vertex")) {
      for (size_t k = 0; k < 3 && corners; k++) {
        double value = 0;
        if (!nsvcd__stl_token(text)) return NSVCD_ERROR_SYNTAX;
        nsvcd_result result = nsvcd__text_number(text, &value);
        float *corner = corners + 3 * *count + k;
        if (!result) result = nsvcd__mesh_number(&text->options, k, value, corner);
        if (result) return result;
      }
      in_loop++;
      ++*count;
    } else {
      nsvcd__text_skip_token(text);
    }
  }
  return in_loop == 0 ? NSVCD_OK : NSVCD_ERROR_SYNTAX;
}

// Welds corners (3 triangles, 3), which become vertices. 0 without memory.
static int nsvcd__stl_weld(nsvcd_mesh *mesh, const nsvcd_allocator *alloc) {
  float *positions = mesh->positions;
  uint32_t *indices = mesh->indices;
  uint32_t count = 0;
  if (!nsvcd__weld_all(positions, mesh->vertex_count, indices, alloc)) return 0;
  for (size_t i = 0; i < mesh->vertex_count; i++) {
    const int is_first = indices[i] == i;
    indices[i] = is_first ? count : indices[indices[i]];
    if (!is_first) continue;
    for (size_t k = 0; k < 3; k++)
      // -0 becomes 0
      positions[3 * (size_t)count + k] = positions[3 * i + k] + 0.0f;
    count++;
  }
  mesh->vertex_count = count;
  return 1;
}

// Reads a file, of which `text` is at the beginning. text->line: where it fails, or 0 if no line is
// at fault.
static nsvcd_result nsvcd__stl_read(nsvcd__text *text, const void *data, size_t size,
                                    const nsvcd_allocator *alloc, nsvcd_mesh *mesh) {
  const nsvcd__text begin = *text;
  const uint64_t needed = nsvcd__stl_size(data, size);
  const int is_binary = size == needed || !nsvcd__stl_is_solid(begin) || memchr(data, 0, size);
  if (is_binary && size < needed) return NSVCD_ERROR_FORMAT;
  nsvcd_result result = NSVCD_OK;
  size_t corners = 3 * (size_t)((needed - NSVCD__STL_HEADER) / NSVCD__STL_FACET);
  text->line = 1;
  if (!is_binary) result = nsvcd__stl_text(text, NULL, &corners);
  if (result) return result;
  text->line = 0;
  if (corners > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  if (corners == 0) return NSVCD_ERROR_EMPTY;
  if (!nsvcd__mesh_alloc(mesh, corners, corners / 3, alloc)) return NSVCD_ERROR_MEMORY;
  if (is_binary) {
    result = nsvcd__stl_binary(data, &text->options, mesh->positions, corners);
  } else {
    *text = begin;
    text->line = 1;
    result = nsvcd__stl_text(text, mesh->positions, &corners);
  }
  if (result) return result;
  text->line = 0;
  return nsvcd__stl_weld(mesh, alloc) ? NSVCD_OK : NSVCD_ERROR_MEMORY;
}
#endif  // NSVCD_NO_READERS

// -------------------------------------------------------------------------------------- mesh/files
// In: an OBJ or STL file, and how its numbers become metres. Out: nsvcd_mesh.

#ifndef NSVCD_NO_READERS
NSVCDDEF nsvcd_result nsvcd_mesh_parse(const void *data, size_t size,
                                       const nsvcd_mesh_options *options,
                                       const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                       size_t *error_line) {
  nsvcd__text text;
  nsvcd_mesh out;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  if (error_line) *error_line = 0;
  if (!mesh || !data) return NSVCD_ERROR_ARGUMENT;
  memset(&out, 0, sizeof out);
  nsvcd__text_begin(&text, (const char *)data, size);
  nsvcd_result result = nsvcd__mesh_options_of(options, &text.options);
  if (result) return result;
  int is_stl = text.options.format == NSVCD_MESH_STL;
  if (text.options.format == NSVCD_MESH_ANY)
    is_stl = size == nsvcd__stl_size(data, size) || nsvcd__stl_is_solid(text);
  result = is_stl ? nsvcd__stl_read(&text, data, size, alloc, &out)
                  : nsvcd__obj_read(&text, &arena, &out);
  nsvcd__arena_free(&arena);
  if (result) {
    if (error_line) *error_line = text.line;
    nsvcd_mesh_free(&out, alloc);
    return result;
  }
  *mesh = out;
  return NSVCD_OK;
}

static const nsvcd_mesh_options nsvcd__as_obj = {NSVCD_MESH_OBJ, {0, 0, 0}, 0};
static const nsvcd_mesh_options nsvcd__as_stl = {NSVCD_MESH_STL, {0, 0, 0}, 0};

NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  return nsvcd_mesh_parse(text, size, &nsvcd__as_obj, alloc, mesh, error_line);
}

NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  return nsvcd_mesh_parse(data, size, &nsvcd__as_stl, alloc, mesh, error_line);
}

#ifndef NSVCD_NO_STDIO
// Reads a whole file into the arena.
static nsvcd_result nsvcd__read_file(const char *path, nsvcd__arena *arena, char **text,
                                     size_t *size) {
#ifdef _MSC_VER  // calls fopen unsafe, with /sdl an error
  FILE *file = NULL;
  if (fopen_s(&file, path, "rb")) return NSVCD_ERROR_IO;
#else
  FILE *file = fopen(path, "rb");
  if (!file) return NSVCD_ERROR_IO;
#endif
  // no fseek: pipes work, and a directory is an error
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

NSVCDDEF nsvcd_result nsvcd_mesh_load(const char *path, const nsvcd_mesh_options *options,
                                      const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  char *data;
  size_t size;
  if (error_line) *error_line = 0;
  if (!path || !mesh) return NSVCD_ERROR_ARGUMENT;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  nsvcd_result result = nsvcd__read_file(path, &arena, &data, &size);
  if (!result) result = nsvcd_mesh_parse(data, size, options, alloc, mesh, error_line);
  nsvcd__arena_free(&arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *alloc,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  return nsvcd_mesh_load(path, &nsvcd__as_obj, alloc, mesh, error_line);
}

NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *alloc,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  return nsvcd_mesh_load(path, &nsvcd__as_stl, alloc, mesh, error_line);
}
#endif  // NSVCD_NO_STDIO
#endif  // NSVCD_NO_READERS

// =========================================================== patches: the surface divided in parts

// --------------------------------------------------------------------------------- patches/samples
// In: a checked mesh. Out: S samples, oriented points of its surface; and what its N patches are
// stored in: samples grouped by patch, and a ball for each patch. Everything in patches/ is
// deterministic and, up to rounding, scales and moves with the mesh.

#ifndef NSVCD_NO_ENCODER
// the mean
#define NSVCD__SAMPLES_PER_PATCH 32
#define NSVCD__NO_SAMPLE 0xffffffffu
#define NSVCD__LLOYD_STEPS 3
// of each centre, to search for the nearest one
#define NSVCD__NEIGHBOURS 16
// longest edge of a piece, in mean sample radii
#define NSVCD__PIECE_SIZE 0.25
// limits the pieces that halving adds
#define NSVCD__PIECES_PER_SAMPLE 64

// Sums over a patch, in double, rounded once at the end.
typedef struct nsvcd__patch_sum {
  // of positions of samples, or of area vectors
  nsvcd__d3 vector;
  double weight;  // number of samples
  // the greatest squared distance from the centre
  double greatest;
} nsvcd__patch_sum;

typedef struct nsvcd__patches {
  size_t count;         // N
  size_t sample_count;  // S
  // triangles and parts of them that the balls were fitted to
  size_t piece_count;
  // (N) metres: the mean of the patch's samples
  nsvcd__f3 *centres;
  // (N) metres: the ball about the centre contains the patch's pieces
  float *radii;
  // (N) metres: the same for its samples
  float *sample_radii;
  // (N) sums of area times normal; their sum is the mesh's
  nsvcd__f3 *area_vectors;
  // (N + 1) patch i has the samples offsets[i] .. offsets[i + 1] - 1
  uint32_t *offsets;
  nsvcd__f3 *samples;  // (S) metres
  nsvcd__f3 *normals;  // (S) unit

  // Working memory.
  nsvcd__patch_sum *sums;  // (N)
  // (S) the samples in the order in which they were drawn
  nsvcd__f3 *drawn, *drawn_normals;
  // (S) the patch of each
  uint16_t *owners;
  // (S) squared distance from the owner's centre; in the memory of `samples`
  float *squares;
  // (S), (N) linked lists of each centre's samples; the first one in the memory of `samples`
  uint32_t *next_sample, *first_sample;
  // (N) each centre's farthest sample, and its squared distance
  uint32_t *farthest_sample;
  float *greatest;
  // (N, NEIGHBOURS) the nearest other centres, nearest first, and a quarter of their squared
  // distance
  uint32_t *neighbours;
  float *quarter_squares;
} nsvcd__patches;

// ---- samples

// In double: differences of floats are next to exact.
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
  return nsvcd__d3_norm(nsvcd__area_vector(t));
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
// triangle where the area, summed in triangle order, passes (k + 1/2) / count of the total. Its
// position there comes from the R2 sequence (Roberts 2018: multiples of 1/g and 1/g^2, g^3 = g +
// 1). Without any area, triangles have equal weights and normals are 0.
static void nsvcd__sample_surface(const nsvcd_mesh *mesh, size_t count, nsvcd__f3 *samples,
                                  nsvcd__f3 *normals) {
  const double all = nsvcd__mesh_area(mesh);
  const double total = all > 0 ? all : (double)mesh->triangle_count;
  nsvcd__triangle triangle;
  double area = 0;
  // the area up to this triangle, which is included
  double passed = 0;
  size_t next = 0;
  for (size_t k = 0; k < count; k++) {
    const double target = total * (((double)k + 0.5) / (double)count);
    // this never stops at a triangle without area
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

// Makes room for patches and samples. 0 without memory.
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
  p->greatest = NSVCD__TAKE(arena, float, count);
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
// In: samples. Out: centres, and the samples nearest to each.

#ifndef NSVCD_NO_ENCODER
// The squared distance of a point from a centre.
static float nsvcd__to_centre2(const nsvcd__patches *p, uint32_t centre, nsvcd__f3 at) {
  const nsvcd__f3 offset = nsvcd__f3_sub(p->centres[centre], at);
  return nsvcd__f3_dot(offset, offset);
}

// Lists the nearest other centres of each centre. A list that is not full ends in infinities.
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

// The centre nearest to a point; of equals the first. A centre that is twice as far from the guess
// as the point is cannot be nearer to the point (triangle inequality), so the guess's neighbours
// usually decide. Where they do not, the best of them is the next guess, or all centres are tried.
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
  p->greatest[centre] = -1;
}

// Adds a sample to its owner's list. square: of the distance between them.
static inline void nsvcd__give_sample(nsvcd__patches *p, uint32_t s, uint32_t owner,
                                      float square) {
  p->owners[s] = (uint16_t)owner;
  p->squares[s] = square;
  p->next_sample[s] = p->first_sample[owner];
  p->first_sample[owner] = s;
  if (square > p->greatest[owner]) {
    p->greatest[owner] = square;
    p->farthest_sample[owner] = s;
  }
}

// Farthest point sampling (Gonzalez 1985). The first centre is the sample farthest from the mean.
// Ends early when every sample is at a centre.
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
      farthest = p->greatest[i] > p->greatest[farthest] ? i : farthest;
    if (!(p->greatest[farthest] > 0)) break;
    p->centres[count] = p->drawn[p->farthest_sample[farthest]];
    nsvcd__forget_samples(p, count);
    for (uint32_t owner = 0; owner < count; owner++) {
      // An owner more than twice as far away as its farthest sample loses none (triangle
      // inequality). Most owners are that far away.
      const float square = nsvcd__to_centre2(p, owner, p->centres[count]);
      if (0.25f * square > p->greatest[owner]) continue;
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

// Moves every centre to the mean of its samples, and drops centres that have none.
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
    // until samples are grouped: the new number of patch i
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

// Extends a patch's reach to a point.
static void nsvcd__extend(nsvcd__patches *p, size_t patch, nsvcd__d3 at) {
  nsvcd__patch_sum *sum = &p->sums[patch];
  const double square = nsvcd__d3_distance2(at, nsvcd__d3_widen(p->centres[patch]));
  sum->greatest = nsvcd__max(sum->greatest, square);
}

// The square root, rounded up: a radius is never too small.
static float nsvcd__radius_above(double squared) {
  return (float)(sqrt(squared) * (1 + 4e-7));
}

// Writes the samples patch by patch (counting sort), and the sample radii.
static void nsvcd__group_samples(nsvcd__patches *p) {
  memset(p->offsets, 0, (p->count + 1) * sizeof *p->offsets);
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t s = 0; s < p->sample_count; s++) p->offsets[p->owners[s] + 1]++;
  for (size_t i = 0; i < p->count; i++) p->offsets[i + 1] += p->offsets[i];

  for (size_t s = 0; s < p->sample_count; s++) {
    const uint32_t owner = p->owners[s];
    // in the end each offset is the next patch's
    const size_t to = p->offsets[owner]++;
    p->samples[to] = p->drawn[s];
    p->normals[to] = p->drawn_normals[s];
    nsvcd__extend(p, owner, nsvcd__d3_widen(p->drawn[s]));
  }
  memmove(p->offsets + 1, p->offsets, p->count * sizeof *p->offsets);
  p->offsets[0] = 0;
  for (size_t i = 0; i < p->count; i++)
    p->sample_radii[i] = nsvcd__radius_above(p->sums[i].greatest);
}
#endif  // NSVCD_NO_ENCODER

// -------------------------------------------------------------------------------- patches/covering
// In: centres, their samples, and the mesh. Out: a ball for each patch; together they contain every
// triangle.
//
// Triangles are halved across their longest edges until no edge exceeds `limit`. Each half goes to
// the patch whose centre is nearest to its centroid, and that patch's ball grows to contain its
// three corners, and so all of it.

#ifndef NSVCD_NO_ENCODER
// The squared lengths of a triangle's edges, each from a corner to the next. Returns which is the
// longest; of equals the first.
static inline size_t nsvcd__edge_squares(const nsvcd__triangle *t, double *e) {
  for (size_t k = 0; k < 3; k++)
    e[k] = nsvcd__d3_distance2(t->at[k], t->at[k == 2 ? 0 : k + 1]);
  return nsvcd__d3_longest(nsvcd__d3_of(e[0], e[1], e[2]));
}

// How many halves a triangle makes; stops counting beyond `most`. The new edge is the median of the
// longest one (Apollonius's theorem), so lengths are all that it takes.
static double nsvcd__count_pieces(const double *e, double limit, double most) {
  const size_t k = nsvcd__d3_longest(nsvcd__d3_of(e[0], e[1], e[2]));
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

// Doubles the limit on edges until a mesh makes at most `most` halves. Writes how many.
static double nsvcd__raise_limit(const nsvcd_mesh *mesh, double limit, double most,
                                 double *pieces) {
  // A triangle makes at least as many halves as its longest edge is limits long, so no lower limit
  // can do.
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

// Halves a triangle until its edges are short, and gives each half to the patch with the nearest
// centre. vector: area times normal. guess: a patch near by. Returns the last half's patch, which
// is a guess for the next triangle.
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
    for (size_t i = 0; i < 3; i++) nsvcd__extend(p, patch, t->at[i]);
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
  // a limit that is too high only makes balls larger
  double limit = 0;
  for (size_t i = 0; i < p->count; i++) limit += (double)p->sample_radii[i] / (double)p->count;
  limit *= NSVCD__PIECE_SIZE;
  // 0: all samples of each patch coincide
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
    // Samples may lie outside of the halves that their patch was given: the ball contains both.
    const float radius = nsvcd__radius_above(sum->greatest);
    p->radii[i] = fmaxf(radius, p->sample_radii[i]);
    p->area_vectors[i] = nsvcd__d3_narrow(sum->vector);
  }
}

// ---- all of it

// Splits the surface of a checked mesh into at most `count` patches, 1..NSVCD_SMALL_PATCHES: fewer
// if samples coincide, or a patch loses all of its own. MEMORY.
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
// In: a checked mesh. Out: its topology: vertices at the same position are one, triangles that
// share vertices are one component, and a component is closed or not.

#ifndef NSVCD_NO_ENCODER
// Of the vertices at one position the first stands for all. A component is named by its root, its
// least vertex.
typedef struct nsvcd__topology {
  const nsvcd_mesh *mesh;
  size_t component_count;
  // (vertices) the first vertex at the same position
  uint32_t *welded;
  // (vertices) a union-find forest; once built, the root
  uint32_t *parents;
  // (vertices) 1 at a root: its component is not closed
  uint8_t *open;
  // (vertices) 1 at a root: it has a triangle
  uint8_t *seen;
} nsvcd__topology;

static void nsvcd__welded_face(const nsvcd__topology *topo, size_t t, uint32_t *face) {
  const uint32_t *corners = topo->mesh->indices + 3 * t;
  face[0] = topo->welded[corners[0]];
  face[1] = topo->welded[corners[1]];
  face[2] = topo->welded[corners[2]];
}

static int nsvcd__are_distinct(const uint32_t *face) {
  return face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

static uint32_t nsvcd__root(uint32_t *parents, uint32_t v) {
  while (parents[v] != v) {
    parents[v] = parents[parents[v]];
    v = parents[v];
  }
  return v;
}

// Joins the trees of a and b: the lesser root stays one.
static void nsvcd__join_roots(uint32_t *parents, uint32_t a, uint32_t b) {
  a = nsvcd__root(parents, a);
  b = nsvcd__root(parents, b);
  parents[a > b ? a : b] = a < b ? a : b;
}

// Finds the components that are not closed: those whose directed edges do not cancel. 0 without
// memory.
static int nsvcd__find_open(nsvcd__topology *topo, const nsvcd_allocator *alloc) {
  const nsvcd_mesh *mesh = topo->mesh;
  const size_t vertices = mesh->vertex_count;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  // where the edges begin whose lesser end is a vertex; while they are sorted, one entry further
  size_t *first = NSVCD__TAKE(&arena, size_t, vertices + 2);
  // the greater end
  uint32_t *ends = NSVCD__TAKE(&arena, uint32_t, 3 * mesh->triangle_count);
  // 1: the edge leads to its greater end; -1: from it
  int8_t *signs = NSVCD__TAKE(&arena, int8_t, 3 * mesh->triangle_count);
  // sums of signs by greater end, over the edges of one vertex; else zeros
  int32_t *balances = NSVCD__TAKE(&arena, int32_t, vertices);
  // counting sort of the edges: count, then store
  for (int pass = 0; !arena.failed && pass < 2; pass++) {
    for (size_t t = 0; t < mesh->triangle_count; t++) {
      uint32_t face[3];
      nsvcd__welded_face(topo, t, face);
      // the edges of any other cancel each other
      if (!nsvcd__are_distinct(face)) continue;
      for (size_t k = 0; k < 3; k++) {
        const uint32_t from = face[k];
        const uint32_t to = face[(k + 1) % 3];
        const uint32_t low = from < to ? from : to;
        const size_t e = first[low + 2 - (size_t)pass]++;
        if (pass == 0) continue;
        ends[e] = from < to ? to : from;
        signs[e] = from < to ? 1 : -1;
      }
    }
    for (size_t v = 0; pass == 0 && v < vertices; v++) first[v + 2] += first[v + 1];
  }
  for (size_t v = 0; !arena.failed && v < vertices; v++) {
    for (size_t e = first[v]; e < first[v + 1]; e++) balances[ends[e]] += signs[e];
    for (size_t e = first[v]; e < first[v + 1]; e++) {
      if (balances[ends[e]] != 0) topo->open[topo->parents[v]] = 1;
    }
    for (size_t e = first[v]; e < first[v + 1]; e++) balances[ends[e]] = 0;
  }
  nsvcd__arena_free(&arena);
  return !arena.failed;
}

// 0 without memory.
static int nsvcd__topology_build(const nsvcd_mesh *mesh, nsvcd__arena *arena,
                                 nsvcd__topology *topo) {
  topo->mesh = mesh;
  topo->component_count = 0;
  topo->welded = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count);
  topo->parents = NSVCD__TAKE(arena, uint32_t, mesh->vertex_count);
  topo->open = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  topo->seen = NSVCD__TAKE(arena, uint8_t, mesh->vertex_count);
  if (arena->failed ||
      !nsvcd__weld_all(mesh->positions, mesh->vertex_count, topo->welded, arena->allocator))
    return 0;

  uint32_t *parents = topo->parents;
  uint32_t face[3];
  for (uint32_t v = 0; v < mesh->vertex_count; v++) parents[v] = v;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__welded_face(topo, t, face);
    nsvcd__join_roots(parents, face[0], face[1]);
    nsvcd__join_roots(parents, face[0], face[2]);
  }
  for (uint32_t v = 0; v < mesh->vertex_count; v++) parents[v] = nsvcd__root(parents, v);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__welded_face(topo, t, face);
    topo->component_count += !topo->seen[parents[face[0]]];
    topo->seen[parents[face[0]]] = 1;
  }
  return nsvcd__find_open(topo, arena->allocator);
}
#endif  // NSVCD_NO_ENCODER

// ----------------------------------------------------------------------------------- patches/edges
// In: the triangles of a mesh's components that are not closed. Out: which of them share each edge,
// after corners at edges that lack a triangle have been joined to others that are near enough, and
// triangles that are there twice or have equal corners have been set aside.

#ifndef NSVCD_NO_ENCODER
// Corners are joined up to this distance, as a fraction of the diagonal of the mesh's box, and of
// the longest edge at either.
#define NSVCD__JOINED 1e-4
#define NSVCD__JOINED_OF_EDGE 0.01
// vertices that are tried in a cell
#define NSVCD__JOIN_TRIES 64

// The triangles of components that are not closed, without those that are points or segments.
typedef struct nsvcd__mending {
  const nsvcd__topology *topo;
  size_t count;  // T
  // (T) of the mesh
  uint32_t *triangles;
  // (vertices) what a welded vertex was joined to, or itself
  uint32_t *joined;
  uint8_t *alive;  // (T) 0: set aside
  // (3 T) edges, sorted by their ends: edge k of triangle n is 3 n + k
  uint32_t *order;
  // E groups of edges with the same ends: (3 T) the group of each edge; (E + 1) where a group
  // begins in `order`
  uint32_t *groups, *group_first;
  size_t group_count;
  // (E) how many alive triangles have this edge, and the exclusive or of their numbers
  uint32_t *degrees, *others;
  // (T) union-find forests: of all triangles that edges join, and of the alive ones
  uint32_t *wholes, *parts;
  // (vertices + 1) working memory
  size_t *first;
  // (3 T) working memory
  uint32_t *spare;
} nsvcd__mending;

static void nsvcd__mending_face(const nsvcd__mending *m, size_t n, uint32_t *face) {
  nsvcd__welded_face(m->topo, m->triangles[n], face);
  for (size_t k = 0; k < 3; k++) face[k] = m->joined[face[k]];
}

static nsvcd__triangle nsvcd__mending_triangle(const nsvcd__mending *m, size_t n) {
  return nsvcd__triangle_of(m->topo->mesh, m->triangles[n]);
}

// The ends of an edge, the lesser first. rises: 1: its triangle goes from that to the other.
typedef struct nsvcd__edge {
  uint32_t ends[2];
  int rises;
} nsvcd__edge;

static NSVCD__NOINLINE nsvcd__edge nsvcd__mending_edge(const nsvcd__mending *m, size_t e) {
  uint32_t face[3];
  nsvcd__mending_face(m, e / 3, face);
  const uint32_t from = face[e % 3];
  const uint32_t to = face[(e + 1) % 3];
  const nsvcd__edge out = {{from < to ? from : to, from < to ? to : from}, from < to};
  return out;
}

// Is edge e the only one of an alive triangle at its ends?
static int nsvcd__is_border(const nsvcd__mending *m, size_t e) {
  return m->alive[e / 3] && m->degrees[m->groups[e]] == 1;
}

// Sorts edges by one of their ends. Counting sort: equal ones keep their order.
static void nsvcd__sort_edges(nsvcd__mending *m, const uint32_t *from, uint32_t *to,
                              size_t which) {
  const size_t vertices = m->topo->mesh->vertex_count;
  memset(m->first, 0, (vertices + 1) * sizeof *m->first);
  for (size_t e = 0; e < 3 * m->count; e++)
    m->first[nsvcd__mending_edge(m, e).ends[which] + 1]++;
  for (size_t v = 0; v < vertices; v++) m->first[v + 1] += m->first[v];
  for (size_t i = 0; i < 3 * m->count; i++)
    to[m->first[nsvcd__mending_edge(m, from[i]).ends[which]]++] = from[i];
}

// Counts the alive triangles at each edge.
static void nsvcd__count_degrees(nsvcd__mending *m) {
  memset(m->degrees, 0, m->group_count * sizeof *m->degrees);
  memset(m->others, 0, m->group_count * sizeof *m->others);
  for (size_t e = 0; e < 3 * m->count; e++) {
    if (!m->alive[e / 3]) continue;
    m->degrees[m->groups[e]]++;
    m->others[m->groups[e]] ^= (uint32_t)(e / 3);
  }
}

// Groups equal edges, and sets aside triangles that are there twice or have equal corners.
static void nsvcd__group_edges(nsvcd__mending *m) {
  uint32_t *seen = m->parts;
  nsvcd__edge last = {{0, 0}, 0};
  uint32_t face[3];
  m->group_count = 0;
  for (size_t n = 0; n < m->count; n++) {
    nsvcd__mending_face(m, n, face);
    m->alive[n] = (uint8_t)nsvcd__are_distinct(face);
  }
  for (size_t e = 0; e < 3 * m->count; e++) m->order[e] = (uint32_t)e;
  nsvcd__sort_edges(m, m->order, m->spare, 1);
  nsvcd__sort_edges(m, m->spare, m->order, 0);
  for (size_t i = 0; i < 3 * m->count; i++) {
    const nsvcd__edge edge = nsvcd__mending_edge(m, m->order[i]);
    if (i == 0 || edge.ends[0] != last.ends[0] || edge.ends[1] != last.ends[1])
      m->group_first[m->group_count++] = (uint32_t)i;
    last = edge;
    m->groups[m->order[i]] = (uint32_t)(m->group_count - 1);
  }
  m->group_first[m->group_count] = (uint32_t)(3 * m->count);
  // Equal triangles share the edge between their two least corners, and the third corner.
  memset(m->first, 0, m->topo->mesh->vertex_count * sizeof *m->first);
  for (size_t g = 0; g < m->group_count; g++) {
    size_t met = 0;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      const size_t n = m->order[i] / 3;
      nsvcd__mending_face(m, n, face);
      const uint32_t third = face[(m->order[i] + 2) % 3];
      const nsvcd__edge edge = nsvcd__mending_edge(m, m->order[i]);
      if (!m->alive[n] || third < edge.ends[1]) continue;
      m->alive[n] = m->first[third] == 0;
      m->first[third] = 1;
      seen[met++] = third;
    }
    while (met > 0) m->first[seen[--met]] = 0;
  }
  nsvcd__count_degrees(m);
}

// ---- corners that are near each other

// A hash table of vertices by cell.
typedef struct nsvcd__cells {
  const nsvcd__mending *m;
  nsvcd__d3 low;
  double width;
  // (slots) the last vertex of a slot + 1, or 0; (vertices) the one before it, likewise
  uint32_t *heads, *before;
  size_t slots;
  // (vertices) metres: how far it may be joined; 0: it is at no edge that lacks a triangle
  float *limits;
} nsvcd__cells;

static uint32_t *nsvcd__cell_of(const nsvcd__cells *c, const double *cell) {
  uint32_t hash = 0;
  for (size_t k = 0; k < 3; k++) {
    hash = (hash ^ (uint32_t)(int64_t)cell[k]) * 0x9e3779b1u;
    hash ^= hash >> 15;
  }
  return &c->heads[(hash * 0x85ebca6bu) & (c->slots - 1)];
}

// Joins a vertex to the nearest one in the table that is near enough, or puts it there itself.
// Returns the distance joined.
static double nsvcd__join_vertex(nsvcd__cells *c, uint32_t v) {
  const float *positions = c->m->topo->mesh->positions;
  const nsvcd__d3 at = nsvcd__d3_row(positions, v);
  const nsvcd__d3 off = nsvcd__d3_scale(nsvcd__d3_sub(at, c->low), 1 / c->width);
  double own[3], side[3];
  double best = HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    const double x = nsvcd__d3_axis(off, k);
    own[k] = floor(x);
    side[k] = x - own[k] < 0.5 ? -1 : 1;
  }
  for (int corner = 0; corner < 8; corner++) {
    double cell[3];
    for (int k = 0; k < 3; k++) cell[k] = own[k] + (corner >> k & 1 ? side[k] : 0);
    uint32_t w = *nsvcd__cell_of(c, cell);
    for (size_t tries = 0; w && tries < NSVCD__JOIN_TRIES; tries++) {
      const double limit = (double)fminf(c->limits[v], c->limits[w - 1]);
      const double square = nsvcd__d3_distance2(at, nsvcd__d3_row(positions, w - 1));
      if (square <= limit * limit && square < best) {
        best = square;
        c->m->joined[v] = w - 1;
      }
      w = c->before[w - 1];
    }
  }
  if (best < HUGE_VAL) return sqrt(best);
  uint32_t *head = nsvcd__cell_of(c, own);
  c->before[v] = *head;
  *head = v + 1;
  return 0;
}

// Sets how far the vertices at edges of an odd number of triangles may be joined, `most` at most.
// Returns how many they are.
static size_t nsvcd__find_limits(const nsvcd__mending *m, double most, float *limits) {
  size_t count = 0;
  for (size_t e = 0; e < 3 * m->count; e++) {
    const nsvcd__triangle t = nsvcd__mending_triangle(m, e / 3);
    const nsvcd__edge edge = nsvcd__mending_edge(m, e);
    if (m->degrees[m->groups[e]] % 2 == 0) continue;
    const double length = sqrt(nsvcd__d3_distance2(t.at[e % 3], t.at[(e + 1) % 3]));
    const float own = (float)nsvcd__min(most, NSVCD__JOINED_OF_EDGE * length);
    for (size_t k = 0; k < 2; k++) {
      float *limit = &limits[edge.ends[k]];
      count += *limit <= 0;
      *limit = fmaxf(own, *limit);
    }
  }
  return count;
}

// Joins corners that are near enough to each other. Returns the greatest distance joined, or -1
// without memory.
static double nsvcd__join_corners(nsvcd__mending *m, const nsvcd_allocator *alloc) {
  const nsvcd_mesh *mesh = m->topo->mesh;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  nsvcd__d3 low = nsvcd__d3_row(mesh->positions, 0);
  nsvcd__d3 high = low;
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    low = nsvcd__d3_min(low, nsvcd__d3_row(mesh->positions, mesh->indices[i]));
    high = nsvcd__d3_max(high, nsvcd__d3_row(mesh->positions, mesh->indices[i]));
  }
  const double most = NSVCD__JOINED * sqrt(nsvcd__d3_distance2(low, high));
  double widest = 0;
  nsvcd__cells c;
  memset(&c, 0, sizeof c);
  c.m = m;
  c.low = low;
  c.width = 2 * most;
  c.limits = NSVCD__TAKE(&arena, float, mesh->vertex_count);
  const size_t left = c.limits ? nsvcd__find_limits(m, most, c.limits) : 0;
  for (c.slots = 16; c.slots / 2 < left;) c.slots *= 2;
  c.heads = NSVCD__TAKE(&arena, uint32_t, c.slots);
  c.before = NSVCD__TAKE(&arena, uint32_t, mesh->vertex_count);
  for (uint32_t v = 0; !arena.failed && v < mesh->vertex_count; v++) {
    if (c.limits[v] > 0) widest = nsvcd__max(widest, nsvcd__join_vertex(&c, v));
  }
  nsvcd__arena_free(&arena);
  return arena.failed ? -1 : widest;
}

// Groups the edges of `m` and joins corners, of the triangles and the topology that stand in it. 0
// without memory.
static int nsvcd__mending_build(nsvcd__mending *m, nsvcd__arena *arena) {
  const size_t vertices = m->topo->mesh->vertex_count;
  const size_t count = m->count;
  m->joined = NSVCD__TAKE(arena, uint32_t, vertices);
  m->alive = NSVCD__TAKE(arena, uint8_t, count);
  m->order = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->groups = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->group_first = NSVCD__TAKE(arena, uint32_t, 3 * count + 1);
  m->degrees = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->others = NSVCD__TAKE(arena, uint32_t, 3 * count);
  m->wholes = NSVCD__TAKE(arena, uint32_t, count);
  m->parts = NSVCD__TAKE(arena, uint32_t, count);
  m->first = NSVCD__TAKE(arena, size_t, vertices + 1);
  m->spare = NSVCD__TAKE(arena, uint32_t, 3 * count);
  if (arena->failed) return 0;
  for (uint32_t v = 0; v < vertices; v++) m->joined[v] = v;
  nsvcd__group_edges(m);
  const double widest = nsvcd__join_corners(m, arena->allocator);
  if (widest < 0) return 0;
  if (widest > 0) nsvcd__group_edges(m);
  return 1;
}
#endif  // NSVCD_NO_ENCODER

// ---------------------------------------------------------------------------------- patches/solids
// In: a mesh's topology. Out: what each triangle is part of: a sheet, a closed surface, one that is
// closed but for its winding, or nearly a solid: one with a hole.
//
// A point is inside closed components if they wind about it. That needs a cycle: each directed edge
// has its reverse. A component that is none may contain one, once harmless flaws are set aside, in
// this order, the first two by patches/edges:
//   1. Corners at edges that lack a triangle are joined to others that are near enough.
//   2. Of triangles with the same three corners one stays; those with only two distinct corners go.
//   3. Fins, triangles with an edge that no other has, are set aside, until none is left. So are
//      inner walls: where edges of three meet, the part with the least area.
//   4. What is left is judged part by part (triangles that share edges). It is a cycle; or each
//      edge has an even number of triangles, and then a ray from inside crosses it an odd number of
//      times, however it is wound. Of a sheet nothing is left. A part of the second kind is a sheet
//      if it has less than half the area of all that its edges join: rooms on a terrain are not
//      turned inside out.
//   5. What is still open is a sheet, or nearly a solid: see nsvcd__judge_holes.
// The caller's triangles stay as they are, and are all proven apart. This decides only which of
// them a ray counts.

#ifndef NSVCD_NO_ENCODER
// Nearly a solid: its holes have at most this fraction of its area; a hole of three edges counts
// only this fraction of itself.
#define NSVCD__HOLES 0.02
#define NSVCD__HOLE_OF_THREE 0.04
// least mean cosine between a hole and the surface about it, if that goes on across the hole
#define NSVCD__FLUSH 0.25
// a hole is a slit if its area is at most this fraction of its border's length squared
#define NSVCD__SLIT 1e-3

typedef struct nsvcd__solids {
  // (triangles) NSVCD__SHEET and so on
  uint8_t *kinds;
  size_t components, open_components, open_edges;
  // metres: the widest gap that was closed
  double gap;
  // 1: there are kinds other than SHEET and CLOSED
  int is_mixed;
} nsvcd__solids;

// ---- parts

// Makes a forest of the alive triangles, joined by edges with at most `most` of them.
static void nsvcd__join_triangles(const nsvcd__mending *m, uint32_t most, uint32_t *forest) {
  for (size_t n = 0; n < m->count; n++) forest[n] = (uint32_t)n;
  for (size_t g = 0; g < m->group_count; g++) {
    uint32_t last = UINT32_MAX;
    if (m->degrees[g] > most) continue;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      const uint32_t n = m->order[i] / 3;
      if (!m->alive[n]) continue;
      if (last != UINT32_MAX) nsvcd__join_roots(forest, n, last);
      last = n;
    }
  }
  for (size_t n = 0; n < m->count; n++) forest[n] = nsvcd__root(forest, (uint32_t)n);
}

// Sets triangles aside that have an edge which no other has, until none is left.
static void nsvcd__peel(nsvcd__mending *m) {
  uint32_t *waiting = m->spare;
  size_t count = 0;
  for (size_t e = 0; e < 3 * m->count; e++) {
    if (!nsvcd__is_border(m, e)) continue;
    m->alive[e / 3] = 0;
    waiting[count++] = (uint32_t)(e / 3);
  }
  while (count > 0) {
    const uint32_t n = waiting[--count];
    for (size_t k = 0; k < 3; k++) {
      const uint32_t g = m->groups[3 * (size_t)n + k];
      m->others[g] ^= n;
      if (--m->degrees[g] != 1) continue;
      const uint32_t next = m->others[g];
      if (m->alive[next]) waiting[count++] = next;
      m->alive[next] = 0;
    }
  }
}

// What is known of a part; of a whole, all that edges join; or of a wall.
typedef struct nsvcd__shell {
  double area;
  nsvcd__d3 centre;  // times the area
  // edges that have an odd number of triangles; that do not go both ways equally often
  uint32_t odd, turned;
  // of a whole: the area of its parts that enclose something; 1: another part does not
  double closed;
  int fails;
  // of a whole: 1: by its holes it is a sheet; the area of these, and the volume inside
  int is_sheet;
  double holes, volume;
} nsvcd__shell;

// Adds up areas and centres of the alive triangles, by their roots in a forest.
static void nsvcd__sum_areas(const nsvcd__mending *m, const uint32_t *forest,
                             nsvcd__shell *parts) {
  for (size_t n = 0; n < m->count; n++) {
    if (!m->alive[n]) continue;
    const nsvcd__triangle t = nsvcd__mending_triangle(m, n);
    const double area = nsvcd__triangle_area(&t);
    nsvcd__shell *part = &parts[forest[n]];
    part->area += area;
    part->centre = nsvcd__d3_fma(area, t.at[0], part->centre);
  }
}

// Counts odd and turned edges of the alive triangles, by their roots in a forest.
static void nsvcd__count_edges(const nsvcd__mending *m, const uint32_t *forest,
                               nsvcd__shell *parts) {
  for (size_t g = 0; g < m->group_count; g++) {
    size_t any = m->count;
    int sum = 0;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      if (!m->alive[m->order[i] / 3]) continue;
      any = m->order[i] / 3;
      sum += nsvcd__mending_edge(m, m->order[i]).rises ? 1 : -1;
    }
    if (any == m->count) continue;
    parts[forest[any]].odd += m->degrees[g] % 2;
    parts[forest[any]].turned += sum != 0;
  }
}

// Sets inner walls aside: triangles joined by edges of two, if at all their other edges, of three,
// they have the least area. Returns how many triangles. walls: (T) zeros, before and after.
static size_t nsvcd__drop_walls(nsvcd__mending *m, nsvcd__shell *walls) {
  size_t dropped = 0;
  nsvcd__join_triangles(m, 2, m->parts);
  nsvcd__sum_areas(m, m->parts, walls);
  for (size_t g = 0; g < m->group_count; g++) {
    size_t least = m->count;
    if (m->degrees[g] < 3) continue;
    for (size_t i = m->group_first[g]; i < m->group_first[g + 1]; i++) {
      const size_t n = m->order[i] / 3;
      if (!m->alive[n]) continue;
      const size_t wall = m->parts[n];
      walls[wall].odd++;
      if (least == m->count || walls[wall].area < walls[least].area) least = wall;
    }
    walls[least].turned += m->degrees[g] % 2;
  }
  for (size_t n = 0; n < m->count; n++) {
    const nsvcd__shell *wall = &walls[m->parts[n]];
    if (!m->alive[n] || wall->odd == 0 || wall->odd != wall->turned) continue;
    m->alive[n] = 0;
    dropped++;
  }
  memset(walls, 0, m->count * sizeof *walls);
  if (dropped > 0) nsvcd__count_degrees(m);
  return dropped;
}

// ---- holes

// A loop of border edges.
typedef struct nsvcd__hole {
  nsvcd__d3 centre, normal;
  double length, area, flush;
  size_t edges;
  uint32_t whole;
} nsvcd__hole;

// Three passes over the border edges: centres; the area and normal of a cone over each hole; and
// how far the triangles about a hole lie in its plane.
static void nsvcd__measure_holes(const nsvcd__mending *m, const uint32_t *numbers,
                                 nsvcd__hole *holes, int pass) {
  for (size_t e = 0; e < 3 * m->count; e++) {
    const nsvcd__triangle t = nsvcd__mending_triangle(m, e / 3);
    if (!nsvcd__is_border(m, e)) continue;
    nsvcd__hole *hole = &holes[numbers[nsvcd__mending_edge(m, e).ends[0]] - 1];
    const nsvcd__d3 from = t.at[e % 3];
    const nsvcd__d3 to = t.at[(e + 1) % 3];
    const double length = sqrt(nsvcd__d3_distance2(from, to));
    if (pass == 0) {
      hole->centre = nsvcd__d3_fma(0.5 * length, nsvcd__d3_add(from, to), hole->centre);
      hole->length += length;
      hole->edges++;
      hole->whole = m->wholes[e / 3];
      continue;
    }
    // a triangle that closed the hole would have the edge reversed
    const nsvcd__d3 centre = nsvcd__d3_scale(hole->centre, 1 / hole->length);
    const nsvcd__d3 a = nsvcd__d3_sub(to, centre);
    const nsvcd__d3 b = nsvcd__d3_sub(from, centre);
    const nsvcd__d3 n = nsvcd__d3_scale(nsvcd__d3_cross(a, b), 0.5);
    if (pass == 1) {
      hole->normal = nsvcd__d3_add(hole->normal, n);
      hole->area += nsvcd__d3_norm(n);
      continue;
    }
    const nsvcd__d3 along = nsvcd__area_vector(&t);
    const double size = nsvcd__d3_norm(along) * nsvcd__d3_norm(hole->normal);
    const double cosine = nsvcd__d3_dot(along, hole->normal);
    hole->flush += size > 0 ? length * cosine / size : 0;
  }
}

// What holes say of the wholes that they are in. A whole is a sheet if the surface does not go on
// across a hole, as at the rim of a bin, a tube or a floor. A slit, such as a corner on an edge
// makes, is no hole, and a missing triangle counts for a fraction of itself. With a larger hole
// only a surface that is wound outwards is nearly a solid: else it is a room with a door. 0 without
// memory.
static int nsvcd__judge_holes(const nsvcd__mending *m, nsvcd__shell *wholes,
                              const nsvcd_allocator *alloc) {
  const size_t vertices = m->topo->mesh->vertex_count;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  uint32_t *forest = NSVCD__TAKE(&arena, uint32_t, vertices);
  uint32_t *numbers = NSVCD__TAKE(&arena, uint32_t, vertices);
  uint32_t count = 0;
  for (uint32_t v = 0; forest && v < vertices; v++) forest[v] = v;
  for (size_t e = 0; !arena.failed && e < 3 * m->count; e++) {
    if (!nsvcd__is_border(m, e)) continue;
    const nsvcd__edge edge = nsvcd__mending_edge(m, e);
    nsvcd__join_roots(forest, edge.ends[0], edge.ends[1]);
    for (size_t k = 0; k < 2; k++) numbers[edge.ends[k]] = 1;
  }
  for (uint32_t v = 0; !arena.failed && v < vertices; v++) {
    if (!numbers[v]) continue;
    const uint32_t root = nsvcd__root(forest, v);
    numbers[v] = root == v ? ++count : numbers[root];
  }
  nsvcd__hole *holes = NSVCD__TAKE(&arena, nsvcd__hole, count);
  for (int pass = 0; !arena.failed && pass < 3; pass++)
    nsvcd__measure_holes(m, numbers, holes, pass);
  for (size_t h = 0; !arena.failed && h < count; h++) {
    const nsvcd__hole *hole = &holes[h];
    nsvcd__shell *whole = &wholes[hole->whole];
    const int is_slit = hole->area <= NSVCD__SLIT * hole->length * hole->length;
    const int is_flush = hole->flush >= NSVCD__FLUSH * hole->length;
    const int is_three = hole->edges == 3;
    whole->holes += (is_three ? NSVCD__HOLE_OF_THREE : 1) * hole->area;
    if (!is_slit && !is_flush) whole->is_sheet = 1;
    if (!is_slit && !is_three && !(whole->volume > 0)) whole->is_sheet = 1;
  }
  nsvcd__arena_free(&arena);
  return !arena.failed;
}

// ---- all of it

// Areas of wholes, and the volumes that they enclose, as seen from their centres.
static void nsvcd__measure_wholes(const nsvcd__mending *m, nsvcd__shell *wholes) {
  nsvcd__sum_areas(m, m->wholes, wholes);
  for (size_t n = 0; n < m->count; n++) {
    nsvcd__shell *whole = &wholes[m->wholes[n]];
    if (!m->alive[n] || !(whole->area > 0)) continue;
    const nsvcd__triangle t = nsvcd__mending_triangle(m, n);
    const nsvcd__d3 centre = nsvcd__d3_scale(whole->centre, 1 / whole->area);
    const nsvcd__d3 normal = nsvcd__area_vector(&t);
    whole->volume += nsvcd__d3_dot(normal, nsvcd__d3_sub(t.at[0], centre)) / 3;
  }
}

// Marks the triangles of the parts, left after peeling, that enclose something.
static void nsvcd__mark_parts(const nsvcd__mending *m, nsvcd__shell *wholes,
                              nsvcd__shell *parts, nsvcd__solids *out) {
  nsvcd__count_edges(m, m->parts, parts);
  nsvcd__sum_areas(m, m->parts, parts);
  for (size_t n = 0; n < m->count; n++) {
    if (!m->alive[n]) continue;
    const nsvcd__shell *part = &parts[m->parts[n]];
    nsvcd__shell *whole = &wholes[m->wholes[n]];
    const int is_most = part->area >= 0.5 * whole->area;
    const int kind = part->turned == 0           ? NSVCD__CLOSED
                     : part->odd == 0 && is_most ? NSVCD__EITHER_DIRECTION
                                                 : NSVCD__SHEET;
    out->kinds[m->triangles[n]] = (uint8_t)kind;
    if (kind == NSVCD__SHEET) {
      whole->fails = 1;
      continue;
    }
    if (m->parts[n] == n) whole->closed += part->area;
    for (size_t k = 0; k < 3; k++) {
      const float *at = m->topo->mesh->positions;
      const uint32_t v = m->topo->mesh->indices[3 * (size_t)m->triangles[n] + k];
      const uint32_t w = m->joined[m->topo->welded[v]];
      const double square = nsvcd__d3_distance2(nsvcd__d3_row(at, v), nsvcd__d3_row(at, w));
      out->gap = nsvcd__max(out->gap, sqrt(square));
    }
  }
}

// Counts the wholes, and marks what is nearly a solid. alive: as before peeling.
static void nsvcd__mark_wholes(const nsvcd__mending *m, nsvcd__shell *wholes,
                               nsvcd__solids *out) {
  for (size_t n = 0; n < m->count; n++) {
    if (!m->alive[n]) continue;
    const nsvcd__shell *whole = &wholes[m->wholes[n]];
    uint8_t *kind = &out->kinds[m->triangles[n]];
    const int is_closed = !whole->fails && whole->closed >= 0.5 * whole->area;
    const int is_nearly = !whole->is_sheet && whole->holes < NSVCD__HOLES * whole->area;
    if (m->wholes[n] == n) {
      out->components++;
      out->open_components += !is_closed;
      out->open_edges += is_closed ? 0 : whole->odd;
    }
    if (!is_closed && is_nearly && *kind == NSVCD__SHEET) *kind = NSVCD__NEARLY;
    out->is_mixed |= *kind == NSVCD__EITHER_DIRECTION || *kind == NSVCD__NEARLY;
  }
}

// Judges all triangles of `m`. 0 without memory.
static int nsvcd__mend(nsvcd__mending *m, nsvcd__arena *arena, nsvcd__solids *out) {
  const size_t count = m->count;
  uint8_t *distinct = NSVCD__TAKE(arena, uint8_t, count);
  nsvcd__shell *wholes = NSVCD__TAKE(arena, nsvcd__shell, count);
  nsvcd__shell *parts = NSVCD__TAKE(arena, nsvcd__shell, count);
  if (arena->failed || !nsvcd__mending_build(m, arena)) return 0;
  memcpy(distinct, m->alive, count);
  nsvcd__join_triangles(m, UINT32_MAX, m->wholes);
  nsvcd__measure_wholes(m, wholes);
  nsvcd__peel(m);
  for (int pass = 0; pass < 8 && nsvcd__drop_walls(m, parts) > 0; pass++) nsvcd__peel(m);
  nsvcd__join_triangles(m, UINT32_MAX, m->parts);
  nsvcd__mark_parts(m, wholes, parts, out);
  memcpy(m->alive, distinct, count);
  nsvcd__count_degrees(m);
  nsvcd__count_edges(m, m->wholes, wholes);
  if (!nsvcd__judge_holes(m, wholes, arena->allocator)) return 0;
  nsvcd__mark_wholes(m, wholes, out);
  return 1;
}

// Judges all triangles of a mesh. 0 without memory.
static int nsvcd__solids_build(const nsvcd__topology *topo, nsvcd__arena *arena,
                               nsvcd__solids *out) {
  const nsvcd_mesh *mesh = topo->mesh;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  nsvcd__mending m;
  memset(&m, 0, sizeof m);
  memset(out, 0, sizeof *out);
  m.topo = topo;
  out->kinds = NSVCD__TAKE(arena, uint8_t, mesh->triangle_count);
  m.triangles = NSVCD__TAKE(&spare, uint32_t, mesh->triangle_count);
  int ok = out->kinds && m.triangles;
  for (size_t v = 0; v < mesh->vertex_count; v++)
    out->components += topo->seen[v] && !topo->open[v];
  for (size_t t = 0; ok && t < mesh->triangle_count; t++) {
    uint32_t face[3];
    nsvcd__welded_face(topo, t, face);
    const int open = topo->open[topo->parents[face[0]]];
    out->kinds[t] = open ? NSVCD__SHEET : NSVCD__CLOSED;
    if (open && nsvcd__are_distinct(face)) m.triangles[m.count++] = (uint32_t)t;
  }
  if (ok && m.count > 0) ok = nsvcd__mend(&m, &spare, out);
  nsvcd__arena_free(&spare);
  return ok;
}
#endif  // NSVCD_NO_ENCODER

// --------------------------------------------------------------------------------- patches/regions
// In: a checked mesh. Out: its triangles, welded, in one region; or in as many regions as it takes
// to have at most 512 patches in each, and each is then split into patches by itself. With several
// regions, triangles that are large beside them are halved first. Both halves are kept, and share
// the new corner, so nothing is lost.

#ifndef NSVCD_NO_ENCODER
// patches of a region, if there are several
#define NSVCD__REGION_PATCHES 256
// longest edge, in square roots of a region's mean area
#define NSVCD__REGION_EDGE 0.5
// a boundary between regions is located to the width of a bin
#define NSVCD__REGION_BINS 512
// limits the triangles that halving adds
#define NSVCD__HALVES_PER_REGION 256

// Points have numbers: first the vertices of the caller's mesh, then the cuts, which halving adds.
typedef struct nsvcd__regions {
  const nsvcd_mesh *mesh;
  // of all coordinates, absolute
  double greatest;
  size_t component_count;  // C
  nsvcd__solids solids;
  // (vertices) 1: the least vertex of its component, which no patch has yet
  uint8_t *seeds;
  size_t count;  // R
  // T, with halves
  size_t triangle_count;
  // (T, 3) points
  uint32_t *corners;
  // (T) number in the caller's mesh, and kind
  uint32_t *ids;
  size_t cut_count, most_cuts;
  nsvcd__d3 *cuts;  // (most_cuts)
  // metres: a triangle with a longer edge is halved
  double longest_edge;

  // If there are several regions:
  // a triangle's weight: per square metre, and for being one
  double per_area, per_triangle;
  // (T) triangles, region by region
  uint32_t *order;
  // (T) working memory
  uint32_t *spare;
  // (vertices and cuts) numbers of points in the region at hand, from 1; 0: none
  uint32_t *numbers;
  // (R + 1) where regions begin in `order`
  size_t *first;
} nsvcd__regions;

// A part of a mesh. Its last vertices are cuts.
typedef struct nsvcd__region {
  // welded; cuts are rounded
  nsvcd_mesh mesh;
  // coordinate of the whole mesh, absolute
  double greatest;
  uint32_t *ids;  // (triangles)
  // (cut_count) not rounded
  nsvcd__d3 *cuts;
  size_t cut_count;
  uint8_t *seeds;  // (vertices)
  // (vertices) their numbers among the points of all regions; NULL: the same
  uint32_t *vertices;
} nsvcd__region;

static nsvcd__d3 nsvcd__regions_point(const nsvcd__regions *r, uint32_t number) {
  const size_t vertices = r->mesh->vertex_count;
  if (number < vertices) return nsvcd__d3_row(r->mesh->positions, number);
  return r->cuts[number - vertices];
}

static nsvcd__triangle nsvcd__regions_corners(const nsvcd__regions *r,
                                              const uint32_t *corners) {
  const nsvcd__triangle out = {{nsvcd__regions_point(r, corners[0]),
                                nsvcd__regions_point(r, corners[1]),
                                nsvcd__regions_point(r, corners[2])}};
  return out;
}

// Adds a triangle, or its halves if an edge is too long and there is room for them.
static void nsvcd__regions_add(nsvcd__regions *r, const uint32_t *corners, uint32_t id) {
  const nsvcd__triangle triangle = nsvcd__regions_corners(r, corners);
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
  return nsvcd__regions_corners(r, r->corners + 3 * (size_t)r->order[i]);
}
static nsvcd__d3 nsvcd__centroid(const nsvcd__triangle *t) {
  const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(t->at[0], t->at[1]), t->at[2]);
  return nsvcd__d3_scale(sum, 1.0 / 3);
}

// Splits order[first .. end - 1] in two. The first part has about this fraction of the weight. The
// boundary is at the end of a bin across the longest axis of the centroids' box; triangles keep
// their order in each part. Returns where the second one begins.
static size_t nsvcd__regions_split(const nsvcd__regions *r, size_t first, size_t end,
                                   double fraction) {
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = first; i < end; i++) {
    const nsvcd__triangle triangle = nsvcd__regions_triangle(r, i);
    const nsvcd__d3 at = nsvcd__centroid(&triangle);
    low = nsvcd__d3_min(low, at);
    high = nsvcd__d3_max(high, at);
  }
  const nsvcd__d3 size = nsvcd__d3_sub(high, low);
  const size_t axis = nsvcd__d3_longest(size);
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
    if (!(sum + 0.5 * next < fraction * all)) break;
    sum += next;
  }

  // The second part waits in `spare`, in place of bins that are no longer needed.
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

// Makes `parts` regions, from number n on, of order[first .. end - 1].
static void nsvcd__regions_part(nsvcd__regions *r, size_t first, size_t end, size_t parts,
                                size_t n) {
  r->first[n] = first;
  if (parts == 1) return;
  const size_t left = parts / 2;
  const double fraction = (double)left / (double)parts;
  const size_t middle = nsvcd__regions_split(r, first, end, fraction);
  nsvcd__regions_part(r, first, middle, left, n);
  nsvcd__regions_part(r, middle, end, parts - left, n + left);
}

// Welds the mesh, and splits it into regions if it is to have more than NSVCD_SMALL_PATCHES
// patches. 0 without memory.
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
    // Lengths come from a formula there, but from corners when triangles are halved: the numbers
    // of halves may differ by roundings.
    r->most_cuts = (size_t)(pieces - triangles) + NSVCD__HALVES_PER_REGION;
  }

  const int known = nsvcd__topology_build(mesh, &scratch, &topology) &&
                    nsvcd__solids_build(&topology, arena, &r->solids);
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
    const uint32_t kind = r->solids.kinds[t];
    nsvcd__regions_add(r, face, (uint32_t)t | kind << NSVCD__KIND_SHIFT);
  }
  nsvcd__arena_free(&scratch);
  if (!ok || r->count == 1) return ok;

  r->per_triangle = 0.5 / (double)r->triangle_count;
  for (uint32_t t = 0; t < r->triangle_count; t++) r->order[t] = t;
  nsvcd__regions_part(r, 0, r->triangle_count, r->count, 0);
  r->first[r->count] = r->triangle_count;
  return 1;
}

// Makes region n. EMPTY if it has no triangle; MEMORY. Call nsvcd__region_end after success.
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

  // number the points in the region: vertices, then cuts
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
  const size_t vertices = points - out->cut_count;
  for (size_t i = 0; i < count; i++) {
    out->ids[i] = r->ids[order[i]];
    for (size_t k = 0; k < 3; k++)
      out->mesh.indices[3 * i + k] = r->numbers[r->corners[3 * (size_t)order[i] + k]] - 1;
  }
  for (size_t v = 0; v < points; v++) {
    const uint32_t from = out->vertices[v];
    const nsvcd__d3 at = nsvcd__regions_point(r, from);
    nsvcd__f3_store(nsvcd__f3_round(at), out->mesh.positions + 3 * v);
    if (v < vertices) out->seeds[v] = r->seeds[from];
    if (v >= vertices) out->cuts[v - vertices] = at;
    r->numbers[from] = 0;
  }
  return NSVCD_OK;
}

// Remembers which seeds patches have been given.
static void nsvcd__region_end(nsvcd__regions *r, const nsvcd__region *region) {
  const size_t vertices = region->mesh.vertex_count - region->cut_count;
  for (size_t v = 0; region->vertices && v < vertices; v++)
    r->seeds[region->vertices[v]] = region->seeds[v];
}
#endif  // NSVCD_NO_ENCODER

// ======================================================= surface: the shape of each patch, bounded

// ---------------------------------------------------------------------------------- surface/pieces
// In: a region, and the centres of its patches. Out: pieces: triangles, cut by the cells of the
// centres.
//
// A piece is a convex part of one triangle, and belongs to one patch. It is only ever divided into
// two parts that share the new corners, and both are kept. So the pieces cover the mesh wherever
// the cuts are, and poor cuts only make the description of a patch larger (surface/surface).

#ifndef NSVCD_NO_ENCODER
// how far a piece may extend into another cell, in mean sample radii
#define NSVCD__SURFACE_OVERLAP 0.5
// a triangle with a longer edge is listed in pieces, in mean sample radii
#define NSVCD__SURFACE_WHOLE 16.0
// of the mesh's greatest coordinate
#define NSVCD__SURFACE_MARGIN 1e-13
// metres, added to that: keeps clear of what float cannot represent
#define NSVCD__SURFACE_TINY 1e-30
// a hull within this fraction of the radius of all corners is good enough
#define NSVCD__HULL_FRACTION 1e-4
// corners of a piece, at most
#define NSVCD__PIECE_CORNERS 16
// polygons that wait to be cut (at most 12 were seen)
#define NSVCD__WAITING 64
// These limit the cuts. A fine mesh takes less than one for each triangle, a large face about three
// for each of its patches.
#define NSVCD__CUTS_PER_TRIANGLE 8
#define NSVCD__CUTS_PER_PATCH 64
// vertices and cuts share numbers of 32 bits
#define NSVCD__MAX_CUTS (1u << 29)

// An array that grows; empty if it is zeros.
typedef struct nsvcd__list {
  void *items;
  size_t count, capacity;
} nsvcd__list;

// Makes room for `more` items of `size` bytes. 0 without memory: the list is unchanged.
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

// A polygon that is being cut. Its corners are numbers of points: first the mesh's welded vertices,
// then the points that cuts have made. While it is divided it may have more than
// NSVCD__PIECE_CORNERS.
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
  // 1: its triangle is listed in pieces
  uint8_t divided;
} nsvcd__piece;

#define NSVCD__WHOLE 0xffffffffu

typedef struct nsvcd__pieces {
  nsvcd__arena *arena;
  const nsvcd__region *region;
  const nsvcd__patches *patches;
  // of nsvcd__piece, triangle by triangle
  nsvcd__list list;
  // of uint32_t, numbers of points
  nsvcd__list corners;
  // of nsvcd__d3, points that cuts have made
  nsvcd__list points;
  // (NSVCD__WAITING)
  nsvcd__convex *waiting;
  size_t waiting_count;
  size_t cuts_left;
  // metres that a piece may extend beyond its cell
  double overlap;
  // metres: a triangle with a longer edge is listed in pieces
  double longest_edge;
  // metres, added to all bounds
  double margin;
  // metres: slabs need not be thinner
  double thin;
} nsvcd__pieces;

static const uint32_t *nsvcd__triangle_corners(const nsvcd__pieces *p, uint32_t triangle) {
  return p->region->mesh.indices + 3 * (size_t)triangle;
}
static const uint32_t *nsvcd__piece_corners(const nsvcd__pieces *p,
                                            const nsvcd__piece *piece) {
  if (piece->first == NSVCD__WHOLE) return nsvcd__triangle_corners(p, piece->triangle);
  return (const uint32_t *)p->corners.items + piece->first;
}

static nsvcd__d3 nsvcd__point_at(const nsvcd__pieces *p, uint32_t number) {
  const nsvcd__region *region = p->region;
  const nsvcd__d3 *made = (const nsvcd__d3 *)p->points.items;
  const size_t vertices = region->mesh.vertex_count;
  const size_t first_cut = vertices - region->cut_count;
  if (number < first_cut) return nsvcd__d3_row(region->mesh.positions, number);
  if (number < vertices) return region->cuts[number - first_cut];
  return made[number - vertices];
}

// Divides a polygon where `beyond`, a value at each corner, changes its sign: near_part is where it
// is negative. There must be room for the new points. 0 if a part has less than three corners,
// which roundings can cause, or too many.
static int nsvcd__divide(nsvcd__pieces *p, const nsvcd__convex *from, const double *beyond,
                         nsvcd__convex *near_part, nsvcd__convex *far_part) {
  const uint32_t vertices = (uint32_t)p->region->mesh.vertex_count;
  const size_t made = p->points.count;
  nsvcd__d3 *points = (nsvcd__d3 *)p->points.items;
  near_part->count = 0;
  far_part->count = 0;
  for (size_t i = 0; i < from->count; i++) {
    const size_t j = (i + 1) % from->count;
    if (beyond[i] <= 0) near_part->points[near_part->count++] = from->points[i];
    if (beyond[i] >= 0) far_part->points[far_part->count++] = from->points[i];
    const int leaves = beyond[i] < 0 && beyond[j] > 0;
    const int enters = beyond[i] > 0 && beyond[j] < 0;
    if (!leaves && !enters) continue;
    const nsvcd__d3 a = nsvcd__point_at(p, from->points[i]);
    const nsvcd__d3 b = nsvcd__point_at(p, from->points[j]);
    const uint32_t number = vertices + (uint32_t)p->points.count;
    const double fraction = beyond[i] / (beyond[i] - beyond[j]);
    points[p->points.count++] = nsvcd__d3_mix(a, b, fraction);
    near_part->points[near_part->count++] = number;
    far_part->points[far_part->count++] = number;
  }
  const size_t most = NSVCD__PIECE_CORNERS;
  if (near_part->count >= 3 && near_part->count <= most && far_part->count >= 3 &&
      far_part->count <= most)
    return 1;
  p->points.count = made;
  return 0;
}

// The distance from a point to a polygon's farthest corner.
static double nsvcd__farthest_corner(const nsvcd__pieces *p, const nsvcd__convex *convex,
                                     nsvcd__d3 from) {
  double squared = 0;
  for (size_t i = 0; i < convex->count; i++) {
    const nsvcd__d3 at = nsvcd__point_at(p, convex->points[i]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(at, from));
  }
  return sqrt(squared);
}

// Cuts off the parts of a polygon that extend too far beyond its patch's cell, and puts them aside
// to be cut later. 0 without memory.
static int nsvcd__trim(nsvcd__pieces *p, uint32_t patch, nsvcd__convex *convex) {
  const nsvcd__patches *patches = p->patches;
  const nsvcd__d3 own = nsvcd__d3_widen(patches->centres[patch]);
  const size_t first = (size_t)patch * NSVCD__NEIGHBOURS;
  double farthest = nsvcd__farthest_corner(p, convex, own);
  for (size_t k = first; k < first + NSVCD__NEIGHBOURS; k++) {
    // the cell's side is half the distance away; those of the next neighbours are farther
    const double plane = sqrt((double)patches->quarter_squares[k]);
    if (farthest <= plane + p->overlap) break;
    if (p->cuts_left == 0 || p->waiting_count == NSVCD__WAITING) break;
    const nsvcd__d3 other = nsvcd__d3_widen(patches->centres[patches->neighbours[k]]);
    const nsvcd__d3 across = nsvcd__d3_sub(other, own);
    const nsvcd__d3 middle = nsvcd__d3_mix(own, other, 0.5);
    const double length = nsvcd__d3_norm(across);
    double beyond[NSVCD__PIECE_CORNERS];
    double most = -HUGE_VAL;
    for (size_t i = 0; i < convex->count; i++) {
      const nsvcd__d3 at = nsvcd__point_at(p, convex->points[i]);
      const double height = nsvcd__d3_dot(nsvcd__d3_sub(at, middle), across);
      beyond[i] = length > 0 ? height / length : -1;
      most = nsvcd__max(most, beyond[i]);
    }
    if (most <= p->overlap) continue;
    nsvcd__list *points = &p->points;
    if (!nsvcd__list_reserve(points, convex->count, sizeof own, p->arena)) return 0;
    nsvcd__convex near_part;
    nsvcd__convex *far_part = &p->waiting[p->waiting_count];
    if (!nsvcd__divide(p, convex, beyond, &near_part, far_part)) continue;
    *convex = near_part;
    p->waiting_count++;
    p->cuts_left--;
    farthest = nsvcd__farthest_corner(p, convex, own);
  }
  return 1;
}

// Cuts a triangle into pieces. guess: the last piece's patch. 0 without memory.
static int nsvcd__cut_up(nsvcd__pieces *p, uint32_t triangle, uint32_t *guess) {
  const uint32_t *corners = nsvcd__triangle_corners(p, triangle);
  nsvcd__piece piece = {NSVCD__WHOLE, triangle, 0, 0, 0};
  double squared = 0;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 a = nsvcd__point_at(p, corners[k]);
    const nsvcd__d3 b = nsvcd__point_at(p, corners[(k + 1) % 3]);
    squared = nsvcd__max(squared, nsvcd__d3_distance2(a, b));
    p->waiting[0].points[k] = corners[k];
  }
  piece.divided = sqrt(squared) > p->longest_edge;
  p->waiting[0].count = 3;
  p->waiting_count = 1;
  while (p->waiting_count > 0) {
    nsvcd__convex convex = p->waiting[--p->waiting_count];
    nsvcd__d3 sum = nsvcd__d3_of(0, 0, 0);
    for (size_t i = 0; i < convex.count; i++)
      sum = nsvcd__d3_add(sum, nsvcd__point_at(p, convex.points[i]));
    const nsvcd__d3 mean = nsvcd__d3_scale(sum, 1 / (double)convex.count);
    *guess = nsvcd__nearest_centre(p->patches, *guess, nsvcd__d3_narrow(mean));
    piece.patch = (uint16_t)*guess;
    if (!nsvcd__trim(p, piece.patch, &convex)) return 0;

    nsvcd__list *list = &p->corners;
    const size_t bytes = convex.count * sizeof *corners;
    piece.count = (uint8_t)convex.count;
    piece.first = NSVCD__WHOLE;
    if (convex.count != 3 || memcmp(convex.points, corners, bytes) != 0) {
      if (list->count >= NSVCD__WHOLE - NSVCD__PIECE_CORNERS) return 0;
      if (!nsvcd__list_reserve(list, convex.count, sizeof *corners, p->arena)) return 0;
      memcpy((uint32_t *)list->items + list->count, convex.points, bytes);
      piece.first = (uint32_t)list->count;
      list->count += convex.count;
    }
    list = &p->list;
    if (!nsvcd__list_reserve(list, 1, sizeof piece, p->arena)) return 0;
    ((nsvcd__piece *)list->items)[list->count++] = piece;
  }
  return 1;
}

// Cuts a region into pieces. 0 without memory.
static int nsvcd__pieces_build(const nsvcd__region *region, const nsvcd__patches *patches,
                               nsvcd__arena *arena, nsvcd__pieces *p) {
  const size_t triangles = region->mesh.triangle_count;
  double size = 0;
  for (size_t i = 0; i < patches->count; i++) size += (double)patches->sample_radii[i];
  size /= (double)patches->count;
  memset(p, 0, sizeof *p);
  p->arena = arena;
  p->region = region;
  p->patches = patches;
  p->margin = NSVCD__SURFACE_MARGIN * region->greatest + NSVCD__SURFACE_TINY;
  p->overlap = NSVCD__SURFACE_OVERLAP * size + p->margin;
  p->longest_edge = NSVCD__SURFACE_WHOLE * size;
  p->cuts_left = NSVCD__CUTS_PER_PATCH * patches->count;
  const size_t room = NSVCD__MAX_CUTS - p->cuts_left;
  const int many = triangles > room / NSVCD__CUTS_PER_TRIANGLE;
  p->cuts_left += many ? room : NSVCD__CUTS_PER_TRIANGLE * triangles;

  p->waiting = NSVCD__TAKE(arena, nsvcd__convex, NSVCD__WAITING);
  // Most triangles are one piece: with room for an eighth more the list rarely has to grow.
  const size_t most = triangles + triangles / 8;
  int ok = p->waiting && nsvcd__list_reserve(&p->list, most, sizeof(nsvcd__piece), arena);
  uint32_t guess = 0;
  for (uint32_t t = 0; ok && t < triangles; t++) ok = nsvcd__cut_up(p, t, &guess);
  return ok;
}
#endif  // NSVCD_NO_ENCODER

// ------------------------------------------------------------------------------------ surface/runs
// In: a mesh of points, segments and triangles, which need no area. Out: its pieces, those of a
// region: whole triangles in runs of neighbours, each of which is a patch.

#ifndef NSVCD_NO_ENCODER
// triangles of a run, if there are many: no more points than a hull can have
#define NSVCD__RUN_LENGTH 16
// runs of a block, so that its memory fits in caches
#define NSVCD__RUNS_AT_ONCE 256
// slabs this thin, as a fraction of the convex radius, are not made thinner
#define NSVCD__RUN_THIN 0.5

// Does a mesh have points or segments for triangles? One without indices is a cloud of points.
static int nsvcd__has_points(const nsvcd_mesh *mesh) {
  if (!mesh->indices) return 1;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    if (!nsvcd__are_distinct(mesh->indices + 3 * t)) return 1;
  }
  return 0;
}

// The default number of runs.
static size_t nsvcd__runs_for(const nsvcd_mesh *mesh) {
  const size_t triangles = mesh->triangle_count;
  const size_t runs = (triangles + NSVCD__RUN_LENGTH - 1) / NSVCD__RUN_LENGTH;
  if (triangles <= NSVCD_VERY_FEW_TRIANGLES) return triangles;
  return runs < NSVCD_MAX_PATCHES ? runs : NSVCD_MAX_PATCHES;
}

// The centroid of triangle t.
static nsvcd__f3 nsvcd__middle_of(const nsvcd_mesh *mesh, size_t t) {
  const uint32_t point[3] = {(uint32_t)t, (uint32_t)t, (uint32_t)t};
  const uint32_t *v = mesh->indices ? mesh->indices + 3 * t : point;
  nsvcd__f3 sum = nsvcd__f3_row(mesh->positions, v[0]);
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[1]));
  sum = nsvcd__f3_add(sum, nsvcd__f3_row(mesh->positions, v[2]));
  return nsvcd__f3_scale(sum, 1.0f / 3);
}

// The bits of a number below 1024, three positions apart.
static uint64_t nsvcd__morton_bits(float from) {
  uint32_t x = (uint32_t)from;
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Radix sort of keys by their upper halves; equal ones keep their order. spare: (count).
static void nsvcd__sort_keys(uint64_t *keys, uint64_t *spare, size_t count) {
  for (unsigned shift = 32; shift < 64; shift += 8) {
    size_t first[257] = {0};
    uint64_t *from = shift & 8 ? spare : keys;
    uint64_t *to = shift & 8 ? keys : spare;
    for (size_t i = 0; i < count; i++) first[1 + (from[i] >> shift & 0xff)]++;
    for (size_t n = 0; n < 256; n++) first[n + 1] += first[n];
    for (size_t i = 0; i < count; i++) to[first[from[i] >> shift & 0xff]++] = from[i];
  }
}

// A mesh along a Z curve (Morton 1966).
typedef struct nsvcd__curve {
  const nsvcd_mesh *mesh;
  // (triangles) the upper half is the position on the curve, the lower one number and kind
  uint64_t *keys;
  // (vertices) when a vertex was last met, counted from 1 over all blocks; 0: never. NULL for a
  // cloud, which has each vertex once
  uint32_t *met;
  uint32_t met_count;
  nsvcd__solids solids;
  // coordinate, absolute
  double greatest;
  double convex_radius;  // metres
} nsvcd__curve;

// Adds the kinds of triangles to the keys. 0 without memory.
static int nsvcd__curve_mark(nsvcd__curve *c, nsvcd__arena *kept) {
  const nsvcd_mesh *mesh = c->mesh;
  // points and segments alone enclose nothing
  if (!mesh->indices || !(nsvcd__mesh_area(mesh) > 0)) return 1;
  nsvcd__topology topology;
  nsvcd__arena arena = nsvcd__arena_of(kept->allocator);
  const int known = nsvcd__topology_build(mesh, &arena, &topology) &&
                    nsvcd__solids_build(&topology, kept, &c->solids);
  for (size_t t = 0; known && t < mesh->triangle_count; t++)
    c->keys[t] |= (uint64_t)c->solids.kinds[t] << NSVCD__KIND_SHIFT;
  nsvcd__arena_free(&arena);
  return known;
}

// Sorts a mesh along the curve. 0 without memory.
static int nsvcd__curve_build(const nsvcd_mesh *mesh, float convex_radius, nsvcd__arena *arena,
                              nsvcd__curve *c) {
  const size_t count = mesh->triangle_count;
  memset(c, 0, sizeof *c);
  c->mesh = mesh;
  c->convex_radius = (double)convex_radius;
  c->keys = NSVCD__TAKE(arena, uint64_t, 2 * count);
  c->met = NSVCD__TAKE(arena, uint32_t, mesh->indices ? mesh->vertex_count : 0);
  if (arena->failed) return 0;
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
    c->greatest = nsvcd__max(c->greatest, fabs((double)mesh->positions[i]));
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
    const uint64_t x = nsvcd__morton_bits(cells * at.x);
    const uint64_t y = nsvcd__morton_bits(cells * at.y);
    const uint64_t z = nsvcd__morton_bits(cells * at.z);
    c->keys[t] = (x | y << 1 | z << 2) << 32 | t;
  }
  if (!nsvcd__curve_mark(c, arena)) return 0;
  nsvcd__sort_keys(c->keys, c->keys + count, count);
  return 1;
}

// Where a run begins on the curve. None is empty.
static size_t nsvcd__run_begin(size_t triangles, size_t run, size_t runs) {
  return (size_t)(((uint64_t)triangles * run + runs - 1) / runs);
}

// Numbers the vertices of a block in the order in which its triangles have them, and copies them. A
// triangle may be a component of its own if none of its vertices was met before.
static void nsvcd__block_vertices(nsvcd__curve *c, nsvcd__region *b) {
  const nsvcd_mesh *mesh = c->mesh;
  const size_t count = b->mesh.triangle_count;
  const uint32_t before = c->met_count;
  if (!mesh->indices) {
    memcpy(b->vertices, b->ids, count * sizeof *b->vertices);
    memset(b->seeds, 1, count);
    b->mesh.vertex_count = count;
  }
  for (size_t n = 0; mesh->indices && n < 3 * count; n++) {
    const uint32_t *face = &b->mesh.indices[n / 3 * 3];
    uint32_t *met = &c->met[b->mesh.indices[n]];
    if (*met <= before) {
      b->seeds[b->mesh.vertex_count] =
          n % 3 == 0 && !c->met[face[0]] && !c->met[face[1]] && !c->met[face[2]];
      b->vertices[b->mesh.vertex_count++] = b->mesh.indices[n];
      *met = ++c->met_count;
    }
    b->mesh.indices[n] = *met - 1 - before;
  }
  for (size_t i = 0; i < b->mesh.vertex_count; i++) {
    const nsvcd__f3 at = nsvcd__f3_row(mesh->positions, b->vertices[i]);
    nsvcd__f3_store(at, b->mesh.positions + 3 * i);
  }
}

// Makes runs first .. last - 1, each a patch; b and patches are what their pieces refer to. The
// triangles and vertices of a block are copied in the order of the curve, so that the rest reads
// memory from front to back; in short loops, each of which can have many loads from far away in
// flight. 0 without memory.
static int nsvcd__runs_build(nsvcd__curve *c, size_t first, size_t last, size_t runs,
                             nsvcd__arena *arena, nsvcd__region *b, nsvcd__patches *patches,
                             nsvcd__pieces *pieces) {
  const nsvcd_mesh *mesh = c->mesh;
  const size_t all = mesh->triangle_count;
  const size_t begin = nsvcd__run_begin(all, first, runs);
  const size_t count = nsvcd__run_begin(all, last, runs) - begin;
  memset(b, 0, sizeof *b);
  memset(patches, 0, sizeof *patches);
  memset(pieces, 0, sizeof *pieces);
  b->mesh.triangle_count = count;
  const size_t most = 3 * count < mesh->vertex_count ? 3 * count : mesh->vertex_count;
  b->mesh.positions = NSVCD__TAKE(arena, float, 3 * most);
  b->mesh.indices = NSVCD__TAKE(arena, uint32_t, 3 * count);
  b->ids = NSVCD__TAKE(arena, uint32_t, count);
  b->vertices = NSVCD__TAKE(arena, uint32_t, most);
  b->seeds = NSVCD__TAKE(arena, uint8_t, most);
  b->greatest = c->greatest;
  patches->count = last - first;
  pieces->arena = arena;
  pieces->region = b;
  pieces->patches = patches;
  pieces->margin = NSVCD__SURFACE_MARGIN * b->greatest + NSVCD__SURFACE_TINY;
  pieces->thin = NSVCD__RUN_THIN * c->convex_radius;
  if (!nsvcd__list_reserve(&pieces->list, count, sizeof(nsvcd__piece), arena) || arena->failed)
    return 0;
  nsvcd__piece *out = (nsvcd__piece *)pieces->list.items;
  pieces->list.count = count;
  size_t run = first;
  size_t end = 0;
  for (size_t k = 0; k < count; k++) {
    if (k == end) end = nsvcd__run_begin(all, ++run, runs) - begin;
    const nsvcd__piece piece = {NSVCD__WHOLE, (uint32_t)k, (uint16_t)(run - 1 - first), 3, 0};
    out[k] = piece;
    b->ids[k] = (uint32_t)c->keys[begin + k];
    const size_t id = b->ids[k] & NSVCD__NUMBER;
    for (size_t n = 3 * k; n < 3 * k + 3; n++) {
      const size_t corner = 3 * id + n - 3 * k;
      b->mesh.indices[n] = mesh->indices ? mesh->indices[corner] : (uint32_t)k;
    }
  }
  nsvcd__block_vertices(c, b);
  return 1;
}
#endif  // NSVCD_NO_ENCODER

// ----------------------------------------------------------------------------------- surface/balls
// In: points, in double. Out: the centre of the least ball that contains them.

#ifndef NSVCD_NO_ENCODER
typedef struct nsvcd__points {
  const nsvcd__d3 *at;  // (count)
  size_t count;
} nsvcd__points;

typedef struct nsvcd__ball {
  nsvcd__d3 centre;
  double squared;  // radius
} nsvcd__ball;

// The edges from the first of 1 to 4 points to the others, and weights for them. The first point
// plus the weighted edges is the centre of the least ball with all points on its surface; or, if
// `ball` is 0, the point nearest to the origin in the plane (line, point) through them. 0 if the
// points are too nearly on a line or in a plane.
static int nsvcd__solve_weights(const nsvcd__d3 *points, size_t count, int ball,
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
  // symmetric and positive definite: the upper half is enough, without pivoting
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

// The least float that is not below x.
static NSVCD__NOINLINE float nsvcd__float_above(double x) {
  const float rounded = nsvcd__to_float(x);
  return (double)rounded < x ? nextafterf(rounded, HUGE_VALF) : rounded;
}

// The least ball with these 1 to 4 points on its surface. 0 if there is none.
static int nsvcd__ball_through(const nsvcd__d3 *points, size_t count, nsvcd__ball *ball) {
  nsvcd__d3 edges[3];
  double weights[3];
  if (!nsvcd__solve_weights(points, count, 1, edges, weights)) return 0;
  nsvcd__d3 offset = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i + 1 < count; i++) offset = nsvcd__d3_fma(weights[i], edges[i], offset);
  ball->centre = nsvcd__d3_add(points[0], offset);
  ball->squared = nsvcd__d3_dot(offset, offset);
  return 1;
}

// Up to five points, on a ball's surface or about to be.
typedef struct nsvcd__border {
  nsvcd__d3 points[5];
  size_t count;
} nsvcd__border;

// The least ball that contains the border (1 to 5 points), among those through its last point and
// up to three others. Keeps in the border only the points on the ball. 0 if there is none.
static NSVCD__NOINLINE int nsvcd__ball_of_few(nsvcd__border *border, nsvcd__ball *ball) {
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

// The centre of the least enclosing ball (after Gaertner 1999, "Fast and robust smallest enclosing
// balls"): the point farthest outside joins the border, until there is none. The ball grows with
// every step. Roundings can stop it early, and then the caller, who takes the radius from the
// points, has a ball that is a little too large.
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
#endif  // NSVCD_NO_ENCODER

// ----------------------------------------------------------------------------------- surface/slabs
// In: points. Out: a slab: a direction in which they are thin, and their extent along it and
// across.

#ifndef NSVCD_NO_ENCODER
// An extent along a direction.
typedef struct nsvcd__drange {
  double low, high;
} nsvcd__drange;

static nsvcd__drange nsvcd__drange_along(nsvcd__points points, nsvcd__d3 direction) {
  nsvcd__drange range = {HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < points.count; i++) {
    const double at = nsvcd__d3_dot(points.at[i], direction);
    range.low = at < range.low ? at : range.low;
    range.high = at > range.high ? at : range.high;
  }
  return range;
}

static double nsvcd__thickness(nsvcd__points points, nsvcd__d3 direction) {
  const nsvcd__drange range = nsvcd__drange_along(points, direction);
  return range.high - range.low;
}

// A direction perpendicular to a unit vector.
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

// Roughly the direction in which the points vary least. The adjugate of their covariance has the
// same axes, and the least becomes the largest; squaring it a few times leaves only that.
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

// Turns a direction in ever smaller steps to where the points are thinner, until they are `thin`.
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

// Fits a slab to points about the centre of the patch's ball. normal: the mean normal of its
// pieces, of any length. thin: metres; a thinner slab is of no use.
static nsvcd__slab nsvcd__fit_slab(nsvcd__points points, nsvcd__d3 normal, double margin,
                                   double thin) {
  nsvcd__d3 best = nsvcd__least_axis(points);
  const nsvcd__d3 mean = nsvcd__d3_unit(normal, best);
  if (nsvcd__thickness(points, mean) < nsvcd__thickness(points, best)) best = mean;
  best = nsvcd__thinner(points, best, thin);
  if (nsvcd__d3_dot(best, normal) < 0) best = nsvcd__d3_scale(best, -1);

  // shorter than 1 by more than the roundings, so that |n| <= 1 as it is stored
  const nsvcd__f3 n = nsvcd__f3_round(nsvcd__d3_scale(best, 1 - 1.5e-7));
  const nsvcd__d3 stored = nsvcd__d3_widen(n);
  const nsvcd__drange range = nsvcd__drange_along(points, stored);
  double squared = 0;
  for (size_t i = 0; i < points.count; i++) {
    const nsvcd__d3 moment = nsvcd__d3_cross(points.at[i], stored);
    squared = nsvcd__max(squared, nsvcd__d3_dot(moment, moment));
  }
  const double across = sqrt(squared / nsvcd__d3_dot(stored, stored));
  nsvcd__slab slab;
  slab.normal = n;
  slab.low = -nsvcd__float_above(-(range.low - margin));
  slab.high = nsvcd__float_above(range.high + margin);
  slab.across = nsvcd__float_above(across * (1 + 1e-6) + margin);
  return slab;
}
#endif  // NSVCD_NO_ENCODER

// ----------------------------------------------------------------------------------- surface/hulls
// In: points. Out: some of them, whose hull inflated by a margin contains all.

#ifndef NSVCD_NO_ENCODER
// The point of a simplex nearest to the origin: weights are positive and sum to 1.
typedef struct nsvcd__simplex {
  nsvcd__d3 points[4];
  double weights[4];
  size_t count;
} nsvcd__simplex;

// Moves the weights to the simplex's point nearest to the origin, and drops corners that it does
// not need (Wolfe 1976, "Finding the nearest point in a polytope"). 0 if roundings prevent that;
// the weights are valid even then.
static int nsvcd__simplex_solve(nsvcd__simplex *s) {
  for (;;) {
    // weights, of any sign, of the point nearest to the origin in the plane of all corners
    nsvcd__d3 edges[3];
    double target[4] = {1};
    if (!nsvcd__solve_weights(s->points, s->count, 0, edges, target + 1)) return 0;
    for (size_t i = 1; i < s->count; i++) target[0] -= target[i];
    double fraction = 1;
    size_t blocking = s->count;
    for (size_t i = 0; i < s->count; i++) {
      const double weight = s->weights[i];
      if (target[i] > 0) continue;
      const double to_zero = weight > 0 ? weight / (weight - target[i]) : 0;
      if (to_zero > fraction) continue;
      fraction = to_zero;
      blocking = i;
    }
    for (size_t i = 0; i < s->count; i++)
      s->weights[i] += fraction * (target[i] - s->weights[i]);
    if (blocking == s->count) return 1;
    s->count--;
    s->points[blocking] = s->points[s->count];
    s->weights[blocking] = s->weights[s->count];
  }
}

// The distance from a point to a point of the convex hull of vertices. It is not less than the
// distance from the hull, and at most 0.2 % above it, but for roundings or if it is below `enough`.
// About ten steps are usual; on x87, whose registers have more digits than memory, it could seem to
// improve for ever.
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
    const int is_solved = nsvcd__simplex_solve(&s);
    nearest = nsvcd__d3_scale(s.points[0], s.weights[0]);
    for (size_t i = 1; i < s.count; i++)
      nearest = nsvcd__d3_fma(s.weights[i], s.points[i], nearest);
    const double squared = nsvcd__d3_dot(nearest, nearest);
    if (!is_solved || squared >= best) break;
    best = squared;
  }
  return sqrt(best);
}

// Chooses at most `most` (up to NSVCD__HULL) of the points so that all are near their hull: all of
// them if they are not more; else always the point farthest from the hull, until that is within
// `enough`. points: about the ball's centre. bounds: working memory, the last distance found of
// each point; it remains a bound, for the hull only grows. Writes the numbers of those chosen and
// the farthest distance; returns how many are chosen.
static size_t nsvcd__choose_hull(nsvcd__points points, size_t most, double enough,
                                 double *bounds, size_t *chosen, double *farthest) {
  nsvcd__d3 at[NSVCD__HULL];
  nsvcd__points hull = {at, 0};
  size_t next = 0;
  double most_distant = 0;
  *farthest = 0;
  if (points.count <= most) {
    for (size_t i = 0; i < points.count; i++) chosen[i] = i;
    return points.count;
  }
  for (size_t i = 0; i < points.count; i++) {
    // the first is the farthest from the centre
    const double distance = nsvcd__d3_norm(points.at[i]);
    if (distance > most_distant) next = i;
    most_distant = nsvcd__max(most_distant, distance);
    bounds[i] = HUGE_VAL;
  }
  *farthest = HUGE_VAL;
  while (*farthest > enough && hull.count < most) {
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
#endif  // NSVCD_NO_ENCODER

// ---------------------------------------------------------------------------------- surface/sorted
// In: pieces. Out: the pieces sorted by patch; and, for the network, the extremes of each patch:
// eight points whose hull is nearly that of all its surface.

#ifndef NSVCD_NO_ENCODER
// Pieces by patch, and working memory for one patch at a time. A pass numbers the points that it
// meets.
typedef struct nsvcd__sorted {
  const nsvcd__pieces *pieces;
  // (N + 1) where the pieces of a patch begin in `order`
  size_t *first;
  // (pieces) their numbers; in a patch as they were made
  uint32_t *order;
  uint32_t pass;  // from 1
  // (points) the last pass that met a point, and its number in that pass
  uint32_t *stamps, *numbers;
  // (met_count) points of the pass, their positions about a centre, and working memory
  uint32_t *met;
  nsvcd__d3 *positions;
  double *bounds;
  size_t met_count;
} nsvcd__sorted;

static const nsvcd__piece *nsvcd__sorted_piece(const nsvcd__sorted *all, size_t k) {
  return (const nsvcd__piece *)all->pieces->list.items + all->order[k];
}

// Sorts the pieces by patch (counting sort). 0 without memory.
static int nsvcd__sorted_build(const nsvcd__pieces *pieces, nsvcd__arena *arena,
                               nsvcd__sorted *all) {
  const nsvcd__piece *items = (const nsvcd__piece *)pieces->list.items;
  const size_t patches = pieces->patches->count;
  const size_t count = pieces->list.count;
  const size_t points = pieces->region->mesh.vertex_count + pieces->points.count;
  size_t *first = NSVCD__TAKE(arena, size_t, patches + 1);
  memset(all, 0, sizeof *all);
  all->pieces = pieces;
  all->first = first;
  all->order = NSVCD__TAKE(arena, uint32_t, count);
  all->stamps = NSVCD__TAKE(arena, uint32_t, points);
  all->numbers = NSVCD__TAKE(arena, uint32_t, points);
  if (arena->failed) return 0;
  for (size_t k = 0; k < count; k++) first[items[k].patch + 1]++;
  for (size_t i = 0; i < patches; i++) first[i + 1] += first[i];
  for (size_t k = count; k-- > 0;) all->order[--first[items[k].patch + 1]] = (uint32_t)k;
  // now first[i + 1] is where patch i begins
  memmove(first, first + 1, patches * sizeof *first);
  first[patches] = count;

  size_t most = 0;
  for (size_t i = 0; i < patches; i++) {
    // the hull's points have numbers of their own
    size_t corners = NSVCD__HULL;
    for (size_t k = first[i]; k < first[i + 1]; k++)
      corners += nsvcd__sorted_piece(all, k)->count;
    most = corners > most ? corners : most;
  }
  all->met = NSVCD__TAKE(arena, uint32_t, most);
  all->positions = NSVCD__TAKE(arena, nsvcd__d3, most);
  all->bounds = NSVCD__TAKE(arena, double, most);
  return !arena->failed;
}

static void nsvcd__begin_pass(nsvcd__sorted *all) {
  all->pass++;
  all->met_count = 0;
}

// Numbers a point, when the pass first meets it.
static void nsvcd__number_point(nsvcd__sorted *all, uint32_t point) {
  if (all->stamps[point] == all->pass) return;
  all->stamps[point] = all->pass;
  all->numbers[point] = (uint32_t)all->met_count;
  all->met[all->met_count++] = point;
}

// Numbers the corners of the pieces of patch i.
static void nsvcd__number_corners(nsvcd__sorted *all, size_t i) {
  nsvcd__begin_pass(all);
  for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
    const nsvcd__piece *piece = nsvcd__sorted_piece(all, k);
    const uint32_t *corners = nsvcd__piece_corners(all->pieces, piece);
    for (size_t j = 0; j < piece->count; j++) nsvcd__number_point(all, corners[j]);
  }
}

// The points of the pass, about a centre.
static nsvcd__points nsvcd__place_points(nsvcd__sorted *all, nsvcd__d3 centre) {
  const nsvcd__points out = {all->positions, all->met_count};
  for (size_t j = 0; j < all->met_count; j++) {
    const nsvcd__d3 at = nsvcd__point_at(all->pieces, all->met[j]);
    all->positions[j] = nsvcd__d3_sub(at, centre);
  }
  return out;
}

#ifndef NSVCD_NO_NETWORK
// Writes the extremes of patch i as a body stores them: (EXTREMES, 3), from its centre in steps of
// radius / 127.
static void nsvcd__extremes_of(nsvcd__sorted *all, size_t i, float radius, int8_t *extremes) {
  const double inverse = radius > 0 ? 127 / (double)radius : 0;
  nsvcd__number_corners(all, i);
  const nsvcd__d3 centre = nsvcd__d3_widen(all->pieces->patches->centres[i]);
  const nsvcd__points points = nsvcd__place_points(all, centre);
  size_t chosen[NSVCD__HULL] = {0};
  double farthest;
  const size_t count =
      nsvcd__choose_hull(points, NSVCD__EXTREMES, 0, all->bounds, chosen, &farthest);
  for (size_t k = 0; k < 3 * NSVCD__EXTREMES; k++) {
    const size_t extreme = chosen[count ? k / 3 % count : 0];
    const double along = count ? nsvcd__d3_axis(points.at[extreme], k % 3) * inverse : 0;
    extremes[k] = (int8_t)lrint(nsvcd__max(-127, nsvcd__min(along, 127)));
  }
}
#endif  // NSVCD_NO_NETWORK
#endif  // NSVCD_NO_ENCODER

// --------------------------------------------------------------------------------- surface/surface
// In: pieces, sorted by patch. Out: nsvcd__surface: for each patch an outer description of the
// surface in it (ball, slab, hull), and its triangles. The proof builds on it.
//
// What holds. Every point of the mesh lies in a piece, and every piece belongs to one patch. That
// patch lists the piece's triangle, or the piece itself if the triangle is large beside the
// patches. Its ball, its slab, and its hull inflated by the margin contain the piece. Triangles
// without area are surface like others.
//
// Why it holds. Pieces cover the mesh (surface/pieces). Each number is taken from the corners of
// pieces, about what is stored in float, and then rounded outwards. A piece is the convex hull of
// its corners, and ball, slab and inflated hull are convex: what contains the corners contains the
// piece. The corners are off by roundings of double: all bounds are wider by NSVCD__SURFACE_MARGIN.

#ifndef NSVCD_NO_ENCODER
// as many as corners of 16 bits can number
#define NSVCD__PATCH_VERTICES 65536u

// The surface in a patch. c: the ball's centre.
typedef struct nsvcd__patch_bounds {
  // an empty patch has radius NSVCD__NOWHERE
  nsvcd__sphere ball;
  nsvcd__slab slab;  // about c
  // metres per integer: a stored point is c + step (x, y, z)
  float step;
  // metres: pieces are within this of the hull of the first stored points
  float margin;
  // metres: corners that are stored points are within this of the exact ones
  float error;
  // how many of these points: 1..NSVCD__HULL; 0: the patch is empty
  uint8_t hull_count;
  // where its stored points, its names and its triangles begin
  uint32_t first_vertex, first_named, first_triangle;
} nsvcd__patch_bounds;

typedef struct nsvcd__surface {
  nsvcd__arena *arena;
  // N, patches so far
  size_t count;
  // (N + 1) the last one only tells where the others end
  nsvcd__patch_bounds *patches;
  // 1: all corners are stored points, and none is named
  int coarse;
  // V, stored points
  size_t vertex_count;
  size_t named_count;  // M, names
  // L, triangles
  size_t listed;
  // (V, 3) patch by patch x of its stored points, then y, then z: the hull's, then corners that
  // cuts have made
  int16_t *vertices;
  // (M) patch by patch the caller's vertices that are corners
  uint32_t *named;
  // (L, 3) numbers in the patch: of stored points, then of names
  uint16_t *corners;
  // (L) triangle of the mesh, and its kind
  uint32_t *ids;
  // these four arrays
  nsvcd__list lists[4];
  nsvcd__solids solids;
  // C, components that are known so far, of each a vertex, and a patch that has it as a corner
  size_t seed_count;
  nsvcd__f3 *seeds;
  uint32_t *seed_patches;
} nsvcd__surface;

// Twice the area vector of the pieces of patch i.
static nsvcd__d3 nsvcd__patch_normal(const nsvcd__sorted *all, size_t i) {
  nsvcd__d3 normal = nsvcd__d3_of(0, 0, 0);
  for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
    const nsvcd__piece *piece = nsvcd__sorted_piece(all, k);
    const uint32_t *corners = nsvcd__piece_corners(all->pieces, piece);
    if (corners[0] == corners[2]) continue;
    const nsvcd__d3 from = nsvcd__point_at(all->pieces, corners[0]);
    nsvcd__d3 area = nsvcd__d3_of(0, 0, 0);
    for (size_t j = 2; j < piece->count; j++) {
      const nsvcd__d3 last = nsvcd__point_at(all->pieces, corners[j - 1]);
      const nsvcd__d3 at = nsvcd__point_at(all->pieces, corners[j]);
      const nsvcd__d3 a = nsvcd__d3_sub(last, from);
      area = nsvcd__d3_add(area, nsvcd__d3_cross(a, nsvcd__d3_sub(at, from)));
    }
    normal = nsvcd__d3_add(normal, area);
  }
  return normal;
}

// Finds ball, slab and hull of patch i. Rounding the hull's points to integers is not in the margin
// yet. hull: (NSVCD__HULL) points.
static void nsvcd__describe_patch(nsvcd__sorted *all, size_t i, nsvcd__surface *s,
                                  uint32_t *hull) {
  const nsvcd__pieces *pieces = all->pieces;
  const nsvcd__region *region = pieces->region;
  nsvcd__patch_bounds *out = &s->patches[s->count];
  nsvcd__number_corners(all, i);
  if (all->met_count == 0) {
    out->ball.centre = pieces->patches->centres[i];
    out->ball.radius = NSVCD__NOWHERE;
    return;
  }
  for (size_t j = 0; j < all->met_count; j++) {
    const uint32_t point = all->met[j];
    if (point >= region->mesh.vertex_count || !region->seeds[point]) continue;
    region->seeds[point] = 0;
    s->seeds[s->seed_count] = nsvcd__f3_row(region->mesh.positions, point);
    s->seed_patches[s->seed_count++] = (uint32_t)s->count;
  }

  // The ball's centre is found near the origin, where roundings are small.
  const nsvcd__d3 from = nsvcd__point_at(pieces, all->met[0]);
  const nsvcd__d3 offset = nsvcd__ball_centre(nsvcd__place_points(all, from));
  out->ball.centre = nsvcd__f3_round(nsvcd__d3_add(from, offset));
  const nsvcd__d3 centre = nsvcd__d3_widen(out->ball.centre);
  const nsvcd__points about = nsvcd__place_points(all, centre);
  double radius = 0;
  for (size_t j = 0; j < about.count; j++)
    radius = nsvcd__max(radius, nsvcd__d3_norm(about.at[j]));
  out->ball.radius = nsvcd__float_above(radius + pieces->margin);
  const nsvcd__d3 normal = nsvcd__patch_normal(all, i);
  out->slab = nsvcd__fit_slab(about, normal, pieces->margin, pieces->thin);

  size_t chosen[NSVCD__HULL];
  double farthest;
  const double enough = NSVCD__HULL_FRACTION * (double)out->ball.radius;
  const size_t count =
      nsvcd__choose_hull(about, NSVCD__HULL, enough, all->bounds, chosen, &farthest);
  out->margin = nsvcd__float_above(farthest + pieces->margin);
  out->hull_count = (uint8_t)count;
  for (size_t k = 0; k < count; k++) hull[k] = all->met[chosen[k]];
}

// What patch i lists for its k-th piece: the piece if its triangle is divided, else the triangle.
// Returns the number of corners, or 0 for nothing: pieces of a triangle follow each other in a
// patch, and the whole triangle is listed with the first.
static size_t nsvcd__listed_corners(const nsvcd__sorted *all, size_t i, size_t k,
                                    const uint32_t **corners) {
  const nsvcd__piece *piece = nsvcd__sorted_piece(all, k);
  *corners = nsvcd__piece_corners(all->pieces, piece);
  if (piece->divided) return piece->count;
  *corners = nsvcd__triangle_corners(all->pieces, piece->triangle);
  const int is_first = k == all->first[i];
  return is_first || nsvcd__sorted_piece(all, k - 1)->triangle != piece->triangle ? 3 : 0;
}

// Is a point named, as a vertex of the caller's mesh?
static int nsvcd__is_named(const nsvcd__sorted *all, const nsvcd__surface *s, uint32_t point) {
  const nsvcd__region *region = all->pieces->region;
  return !s->coarse && point < region->mesh.vertex_count - region->cut_count;
}

// Numbers the points of patch i: the hull's, then corners that are not named, then, from *stored
// on, those that are. Returns how many triangles the patch lists.
static size_t nsvcd__number_vertices(nsvcd__sorted *all, size_t i, const nsvcd__surface *s,
                                     const uint32_t *hull, size_t *stored) {
  size_t listed = 0;
  nsvcd__begin_pass(all);
  for (size_t k = 0; k < s->patches[s->count].hull_count; k++)
    nsvcd__number_point(all, hull[k]);
  for (int named = 0; named < 2; named++) {
    listed = 0;
    // points of the hull that are named have two numbers
    all->pass += (uint32_t)named;
    if (named) *stored = all->met_count;
    for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
      const uint32_t *corners;
      const size_t count = nsvcd__listed_corners(all, i, k, &corners);
      for (size_t j = 0; j < count; j++) {
        if (nsvcd__is_named(all, s, corners[j]) == named) nsvcd__number_point(all, corners[j]);
      }
      listed += count ? count - 2 : 0;
    }
  }
  return listed;
}

// Writes the points of patch i, the first `stored` as integers and the others as names, and its
// triangles.
static void nsvcd__store_patch(nsvcd__sorted *all, size_t i, nsvcd__surface *s,
                               size_t stored) {
  const nsvcd__region *region = all->pieces->region;
  nsvcd__patch_bounds *out = &s->patches[s->count];
  const nsvcd__d3 centre = nsvcd__d3_widen(out->ball.centre);
  const nsvcd__points points = nsvcd__place_points(all, centre);
  for (size_t j = stored; j < points.count; j++) {
    const uint32_t point = all->met[j];
    s->named[s->named_count++] = region->vertices ? region->vertices[point] : point;
  }
  double greatest = NSVCD__SURFACE_TINY;
  for (size_t j = 0; j < 3 * stored; j++)
    greatest = nsvcd__max(greatest, fabs(nsvcd__d3_axis(points.at[j / 3], j % 3)));
  out->step = nsvcd__float_above(greatest / 32767);
  const double metres = (double)out->step;
  int16_t *vertices = s->vertices + 3 * s->vertex_count;
  double worst = 0;
  double worst_of_hull = 0;
  int has_stored = 0;  // corners
  for (size_t j = 0; j < stored; j++) {
    nsvcd__d3 rounded = {0, 0, 0};
    for (size_t k = 0; k < 3; k++) {
      const double nearest = floor(nsvcd__d3_axis(points.at[j], k) / metres + 0.5);
      const double integer = nsvcd__min(nsvcd__max(nearest, -32767), 32767);
      vertices[k * stored + j] = (int16_t)integer;
      nsvcd__d3_set_axis(&rounded, k, metres * integer);
    }
    all->bounds[j] = nsvcd__d3_norm(nsvcd__d3_sub(points.at[j], rounded));
    if (j < out->hull_count) worst_of_hull = nsvcd__max(worst_of_hull, all->bounds[j]);
  }
  s->vertex_count += stored;
  // no point of the hull is off by more than its vertices
  out->margin = nsvcd__float_above((double)out->margin + worst_of_hull);

  for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
    const uint32_t triangle = nsvcd__sorted_piece(all, k)->triangle;
    const uint32_t *corners;
    const size_t count = nsvcd__listed_corners(all, i, k, &corners);
    for (size_t j = 2; j < count; j++) {
      uint16_t *to = s->corners + 3 * s->listed;
      for (size_t n = 0; n < 3; n++) {
        const uint32_t number = all->numbers[corners[n ? j - 2 + n : 0]];
        to[n] = (uint16_t)number;
        if (number >= stored) continue;
        worst = nsvcd__max(worst, all->bounds[number]);
        has_stored = 1;
      }
      s->ids[s->listed++] = region->ids[triangle];
    }
  }
  worst += all->pieces->margin;
  out->error = has_stored ? nsvcd__float_above(worst) : 0;
}

// ---- all of it

// Begins a surface of up to n patches. components: C, at most. coarse: 1: corners are stored as
// integers. 0 without memory.
static int nsvcd__surface_begin(size_t n, size_t components, int coarse, nsvcd__arena *arena,
                                nsvcd__surface *s) {
  memset(s, 0, sizeof *s);
  s->arena = arena;
  s->coarse = coarse;
  s->patches = NSVCD__TAKE(arena, nsvcd__patch_bounds, n + 1);
  s->seeds = NSVCD__TAKE(arena, nsvcd__f3, components);
  s->seed_patches = NSVCD__TAKE(arena, uint32_t, components);
  return !arena->failed;
}

// Makes room for more stored points, names and triangles. 0 without memory.
static int nsvcd__surface_room(nsvcd__surface *s, size_t stored, size_t named,
                               size_t triangles) {
  const size_t counts[4] = {s->vertex_count, s->named_count, s->listed, s->listed};
  const size_t more[4] = {stored, named, triangles, triangles};
  for (size_t k = 0; k < 4; k++) {
    const size_t size = k % 2 ? sizeof(uint32_t) : 3 * sizeof(int16_t);
    s->lists[k].count = counts[k];
    if (!nsvcd__list_reserve(&s->lists[k], more[k], size, s->arena)) return 0;
  }
  s->vertices = (int16_t *)s->lists[0].items;
  s->named = (uint32_t *)s->lists[1].items;
  s->corners = (uint16_t *)s->lists[2].items;
  s->ids = (uint32_t *)s->lists[3].items;
  return 1;
}

// Adds the patches of a region. MEMORY; TOO_LARGE if a patch has more than NSVCD__PATCH_VERTICES
// points, or there are too many in all. After a failure the surface is of no use.
static nsvcd_result nsvcd__surface_add(nsvcd__sorted *all, nsvcd__surface *s) {
  const nsvcd__pieces *pieces = all->pieces;
  // usually enough, so that lists need not grow
  if (!nsvcd__surface_room(s, 0, pieces->list.count, pieces->list.count))
    return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < pieces->patches->count; i++) {
    uint32_t hull[NSVCD__HULL];
    size_t stored = 0;
    nsvcd__describe_patch(all, i, s, hull);
    const size_t triangles = nsvcd__number_vertices(all, i, s, hull, &stored);
    const size_t named = all->met_count - stored;
    if (all->met_count > NSVCD__PATCH_VERTICES ||
        s->vertex_count + stored > NSVCD__MAX_COUNT ||
        s->listed + triangles > NSVCD__MAX_COUNT || s->named_count + named > NSVCD__MAX_COUNT)
      return NSVCD_ERROR_TOO_LARGE;
    if (!nsvcd__surface_room(s, stored, named, triangles)) return NSVCD_ERROR_MEMORY;
    if (triangles > 0) nsvcd__store_patch(all, i, s, stored);
    nsvcd__patch_bounds *next = &s->patches[++s->count];
    next->first_vertex = (uint32_t)s->vertex_count;
    next->first_named = (uint32_t)s->named_count;
    next->first_triangle = (uint32_t)s->listed;
  }
  return NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER

// ====================================================== encoder: what the network keeps of a patch

// ----------------------------------------------------------------------------------- encoder/model
// In: weights.h, which train/ generates. Out: its arrays. Matrices are (inputs, outputs).

#ifndef NSVCD_NO_NETWORK
// A decoder: linear layers with ReLU between them. Offsets instead of pointers need no relocation,
// so that all of it stays in read-only memory.
typedef struct nsvcd__decoder {
  size_t layers;  // 0: compiled out
  // (layers + 1): of the inputs, a multiple of 4, and of the outputs of each layer, multiples of 16
  size_t sizes[6];
  // where its matrices begin: per layer (sizes[l], sizes[l + 1]) floats in nsvcd_w_decoder, and the
  // same numbers over the output's scale in nsvcd_w_decoder_int8, (sizes[l] / 4, sizes[l + 1], 4)
  size_t weights;
  // where numbers of its outputs begin: per layer (sizes[l + 1]) in nsvcd_w_decoder_bias, _scale
  // and _sum (of the int8)
  size_t outputs;
} nsvcd__decoder;

#include "weights.h"

#define NSVCD__LATENT (8 * NSVCD_W_CHANNELS + NSVCD_W_SCALARS)
#endif  // NSVCD_NO_NETWORK

// --------------------------------------------------------------------------------- encoder/encoder
// In: the samples of one patch, its centre, and the radius of its ball. Out: its latent
// (NSVCD__LATENT floats in (-1,1)): NSVCD_W_CHANNELS vectors of degree 1, as many of degree 2, and
// NSVCD_W_SCALARS invariants.
//
// A Vector-Neuron encoder (Deng et al. 2021) on features of degrees 1 and 2 (FER-VN, Son et al.
// 2024). Channels are mixed by matrices shared by all components, and the only nonlinearities are
// gates computed from invariants, so that turning the samples by R turns the latent by D(R).
// Dividing by the radius makes it independent of scale.

#ifndef NSVCD_NO_NETWORK
#ifndef NSVCD_NO_ENCODER
// Channels after pooling.
#define NSVCD__WIDE (NSVCD_W_POOLED + NSVCD_W_CONTEXT)
// Invariants of a sample.
#define NSVCD__INVARIANTS (2 + 5 * NSVCD_W_CONTEXT)
#define NSVCD__GATES (5 * NSVCD_W_POOLED + NSVCD_W_POOLED_SCALARS)
#define NSVCD__PATCH_IN (2 * NSVCD__WIDE + NSVCD_W_POOLED_SCALARS)
#define NSVCD__PATCH_OUT (2 * NSVCD_W_HIDDEN + NSVCD_W_SCALARS)

// A linear layer: y = w^T x + bias; w (inputs, outputs), bias (outputs) or NULL, x (inputs),
// y (outputs), which do not overlap. A sum of rows, which compilers vectorise.
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

// Written out, for compilers that keep the five in memory if it is a loop.
static inline nsvcd__f5 nsvcd__f5_scale(nsvcd__f5 a, float s) {
  const float *v = a.v;
  const nsvcd__f5 out = {{s * v[0], s * v[1], s * v[2], s * v[3], s * v[4]}};
  return out;
}
// s b + a
static inline nsvcd__f5 nsvcd__f5_fma(float s, nsvcd__f5 b, nsvcd__f5 a) {
  const float *v = a.v;
  const float *w = b.v;
  const nsvcd__f5 out = {
      {v[0] + s * w[0], v[1] + s * w[1], v[2] + s * w[2], v[3] + s * w[3], v[4] + s * w[4]}};
  return out;
}
static inline float nsvcd__f5_dot(nsvcd__f5 a, nsvcd__f5 b) {
  const float *v = a.v;
  const float *w = b.v;
  return v[0] * w[0] + v[1] * w[1] + v[2] * w[2] + v[3] * w[3] + v[4] * w[4];
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

// What the encoder sees of a patch.
typedef struct nsvcd__encoded {
  const nsvcd__f3 *samples, *normals;  // (count)
  size_t count;
  nsvcd__f3 centre;
  float inverse_radius;
} nsvcd__encoded;

// A sample's vectors of degree 1 and 2.
typedef struct nsvcd__feature {
  nsvcd__f3 u, n;           // position from the centre, over the radius; unit normal
  float uu, un;             // |u|^2, u.n
  nsvcd__f5 quu, qun, qnn;  // nsvcd__degree2 of both
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

// The channels of a patch: pooled ones, then the context.
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
    m2[0] = nsvcd__f5_fma(1, f.quu, m2[0]);
    m2[1] = nsvcd__f5_fma(1, f.qun, m2[1]);
    m2[2] = nsvcd__f5_fma(1, f.qnn, m2[2]);
    m2[3] = nsvcd__f5_fma(f.un, f.qun, m2[3]);
  }
  const float fraction = 1 / (float)patch->count;
  for (size_t c = 0; c < NSVCD_W_CONTEXT; c++) {
    nsvcd__f3 c1 = {0, 0, 0};
    nsvcd__f5 c2 = {{0, 0, 0, 0, 0}};
    for (size_t m = 0; m < 4; m++) {
      const float w1 = nsvcd_w_context1[m * NSVCD_W_CONTEXT + c];
      const float w2 = nsvcd_w_context2[m * NSVCD_W_CONTEXT + c];
      c1 = nsvcd__f3_fma(fraction, nsvcd__f3_scale(m1[m], w1), c1);
      c2 = nsvcd__f5_fma(fraction, nsvcd__f5_scale(m2[m], w2), c2);
    }
    out->degree1[NSVCD_W_POOLED + c] = c1;
    out->degree2[NSVCD_W_POOLED + c] = c2;
  }
}

// The sample network: a sample's invariants -> its gates (GATES).
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

// The patch network: channels -> latent. The channels of each degree are mixed, gated, and mixed
// again.
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
    // shortened below length 1, so that int8 holds them
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

// The latent (LATENT) of a patch of one or more samples: degree 1 (3, CHANNELS), degree 2 (5,
// CHANNELS), scalars.
static void nsvcd__encode_patch(const nsvcd__encoded *patch, float *latent) {
  const size_t pooled = NSVCD_W_POOLED;
  const float fraction = 1 / (float)patch->count;
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
      a1 = nsvcd__f3_fma(gate[pooled], f.n, a1);
      nsvcd__f5 a2 = nsvcd__f5_scale(f.quu, gate[2 * pooled]);
      a2 = nsvcd__f5_fma(gate[3 * pooled], f.qun, a2);
      a2 = nsvcd__f5_fma(gate[4 * pooled], f.qnn, a2);
      all.degree1[c] = nsvcd__f3_fma(fraction, a1, all.degree1[c]);
      all.degree2[c] = nsvcd__f5_fma(fraction, a2, all.degree2[c]);
    }
    for (size_t c = 0; c < NSVCD_W_POOLED_SCALARS; c++)
      all.scalars[c] += gates[5 * pooled + c] * fraction;
  }
  nsvcd__finish_latent(&all, latent);
}
#endif  // NSVCD_NO_ENCODER
#endif  // NSVCD_NO_NETWORK

// ================================================================================== body: the blob

// --------------------------------------------------------------------------------------- body/body
// In: N patches. Out: one relocatable, checksummed blob. Patches are stored in groups of 16
// neighbours, each with a sphere over its members. If there are many groups, there are levels of
// spheres above them, a tree for the broad phase. There are two kinds of bodies, which begin alike:
//
//   struct nsvcd_body    64 bytes
//   x, y, z, r   (4, P)  float: spheres of the patches, body frame, metres; P = N rounded up to 16;
//                        padding has r = NSVCD__NOWHERE
//   x, y, z, r   (4, G)  float: spheres of the groups; G = P / 16 rounded up to 16, padding as
//                        above. In a body of latents over the patches' spheres; in one of
//                        triangles over the surface in them, which may be much smaller
//   x, y, z, r   (4, H)  float: if there are more than 32 groups, spheres over 16 groups each;
//                        H as G
//   x, y, z, r   (4, I)  float: if these are more than 16, spheres over 16 of them each
//
// A body of latents, for the network, goes on with
//   x, y, z      (3, P)  float: area vectors, square metres, along the outward normal; padding is
//                        zero
//   x, y, z      (3, G), (3, H), (3, I)  float: if there are more than 32 groups, their sums over
//                        the members of the spheres above
//   extremes     (P / 16, 8, 3, 16)  int8: eight points of each patch of a group of 16, from its
//                        centre in steps of r / 127; padding is zero
//   latents      (N, NSVCD__LATENT)  int8, the same at any scale
// and a body of triangles, for the proof, with what body/geometry says. A body that has both is one
// of latents with one of triangles behind it, at `inner`. Patches have the same numbers in both;
// spheres differ. Each part is padded with zeros to a multiple of NSVCD_ALIGNMENT.

// 0: triangles are neither stored nor read
#ifdef NSVCD_NO_PROOF
#define NSVCD__PROOF 0
#else
#define NSVCD__PROOF 1
#endif
// members of a group, and of a sphere of a level
#define NSVCD__GROUP NSVCD__LANES
// Groups of a body that are searched at once; bodies with more have levels above them. (Tests
// define fewer, so that small bodies have several tiles.)
#ifndef NSVCD__TILE
#define NSVCD__TILE 32
#endif
#define NSVCD__TILE_SLOTS 32
#define NSVCD__LEVELS 3  // at most
// metres: no radius or distance of coordinates in range exceeds it
#define NSVCD__MAX_LENGTH 1.6e7f
#define NSVCD__BODY_MAGIC 0x4256534eu  // "NSVB", or "BVSN": the mark of the byte order
#define NSVCD__OTHER_MAGIC 0x4e535642u
#define NSVCD__BODY_VERSION 8u

struct nsvcd_body {
  uint32_t magic, version;
  // of everything that follows
  uint64_t checksum;
  // bytes of the whole blob
  uint32_t size;
  // of the weights that made the latents; 0: a body of triangles
  uint32_t weights_id;
  uint32_t patches;  // N
  uint32_t padded;   // P
  // a sphere over all
  float centre[3], radius;
  // max |p_i| + r_i: nothing is farther from the body's origin
  float extent;
  // 1: nothing can be inside
  uint32_t open;
  // of the mesh; 0: none are stored
  uint32_t triangles;
  // bytes from here to the body of triangles; 0: there is none
  uint32_t inner;
};

static size_t nsvcd__group_slots(size_t padded) {
  return nsvcd__round_up(padded / NSVCD__GROUP, NSVCD__GROUP);
}
// How many of `members` are in the group that begins with number `first`.
static size_t nsvcd__group_members(size_t members, size_t first) {
  const size_t left = first < members ? members - first : 0;
  return left < NSVCD__GROUP ? left : NSVCD__GROUP;
}

// A level of spheres. Level 0 are the groups; a sphere of any other is over 16 of the level below.
typedef struct nsvcd__level {
  size_t count;  // spheres
  // the same, rounded up to 16
  size_t slots;
  // of its floats, from the body's first: x (slots), y, z, r
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

// How many levels there are: none above the groups if these are searched at once.
static size_t nsvcd__level_count(size_t padded) {
  size_t levels = 1;
  if (padded / NSVCD__GROUP <= NSVCD__TILE) return 1;
  while (nsvcd__level_of(padded, levels - 1).count > NSVCD__GROUP) levels++;
  return levels;
}

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

// The address, writable, in a body that is being written.
static void *nsvcd__writable(nsvcd_body *body, const void *address) {
  return (char *)body + ((const char *)address - (const char *)body);
}

// Spheres with their padding: of the patches and all levels.
static size_t nsvcd__sphere_slots(size_t padded) {
  const size_t levels = nsvcd__level_count(padded);
  const nsvcd__level top = nsvcd__level_of(padded, levels - 1);
  return top.first / 4 + top.slots;
}

// Bytes of the header and the spheres.
static size_t nsvcd__spheres_size(size_t padded) {
  return sizeof(struct nsvcd_body) + 16 * nsvcd__sphere_slots(padded);
}

// Area vectors with their padding: one for each sphere, or, without levels above the groups, one
// for each patch.
static size_t nsvcd__area_slots(size_t padded) {
  return nsvcd__level_count(padded) > 1 ? nsvcd__sphere_slots(padded) : padded;
}
// (3, P)
static const float *nsvcd__body_areas(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const float *)(const void *)at;
}
// Bytes of a body of latents up to these.
static size_t nsvcd__latents_begin(size_t padded) {
  return nsvcd__spheres_size(padded) + 12 * nsvcd__area_slots(padded) +
         3 * NSVCD__EXTREMES * padded;
}

#ifndef NSVCD_NO_NETWORK
// (3, slots): the sums over a level's spheres, in a body with levels above the groups.
static const float *nsvcd__level_areas(const nsvcd_body *body, nsvcd__level level) {
  return nsvcd__body_areas(body) + level.first / 4 * 3;
}
// The extremes of a group's patches: (EXTREMES, 3, 16).
static const int8_t *nsvcd__group_extremes(const nsvcd_body *body, size_t g) {
  const float *areas_end = nsvcd__body_areas(body) + 3 * nsvcd__area_slots(body->padded);
  return (const int8_t *)areas_end + 3 * NSVCD__EXTREMES * NSVCD__GROUP * g;
}
// (N, LATENT)
static const int8_t *nsvcd__body_latents(const nsvcd_body *body) {
  return (const int8_t *)body + nsvcd__latents_begin(body->padded);
}

NSVCDDEF size_t nsvcd_body_size(size_t patches) {
  if (patches < 1 || patches > NSVCD_MAX_PATCHES) return 0;
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t latents = patches * NSVCD__LATENT;
  return nsvcd__round_up(nsvcd__latents_begin(padded) + latents, NSVCD_ALIGNMENT);
}
#endif

// FNV-1a, 64 bits, over words of 32 bits. Every step is a bijection of the state, so a change of a
// single word is always detected.
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
// Sorts patches, by numbers, by a coordinate of their centres. A merge sort: equal ones keep their
// order, so the result is the same everywhere. spare: (count).
static void nsvcd__sort_along(const nsvcd__f3 *centres, size_t axis, uint16_t *order,
                              uint16_t *spare, size_t count) {
  const float *at = (const float *)(const void *)centres + axis;
  for (size_t run = 1; run < count; run *= 2) {
    for (size_t first = 0; first < count; first += 2 * run) {
      const size_t middle = first + run < count ? first + run : count;
      const size_t end = first + 2 * run < count ? first + 2 * run : count;
      size_t left = first;
      size_t right = middle;
      for (size_t to = first; to < end; to++) {
        int from_right = left == middle;
        if (left < middle && right < end)
          from_right = at[3 * order[right]] < at[3 * order[left]];
        spare[to] = from_right ? order[right++] : order[left++];
      }
    }
    memcpy(order, spare, count * sizeof *order);
  }
}

// Orders patches so that each run of 16 is compact, and each run of 16 of those: median splits
// across the longest axis of the centres' box. The left part is a multiple of 16, or of 256 and so
// on if there are more than a tile's. spare: (count).
static void nsvcd__body_order(const nsvcd__f3 *centres, uint16_t *order, uint16_t *spare,
                              size_t count) {
  if (count <= NSVCD__GROUP) return;
  nsvcd__f3 low = centres[order[0]];
  nsvcd__f3 high = low;
  for (size_t i = 1; i < count; i++) {
    low = nsvcd__f3_min(low, centres[order[i]]);
    high = nsvcd__f3_max(high, centres[order[i]]);
  }
  const nsvcd__f3 size = nsvcd__f3_sub(high, low);
  const size_t axis = nsvcd__d3_longest(nsvcd__d3_widen(size));
  nsvcd__sort_along(centres, axis, order, spare, count);
  size_t unit = NSVCD__GROUP;
  while (2 * NSVCD__GROUP * unit < count) unit *= NSVCD__GROUP;
  const size_t left = nsvcd__round_up(count / 2, unit);
  nsvcd__body_order(centres, order, spare, left);
  nsvcd__body_order(centres, order + left, spare, count - left);
}

// What a body of latents is built of.
typedef struct nsvcd__latents {
  size_t count;        // N
  nsvcd__f3 *centres;  // (N)
  float *radii;        // (N)
  nsvcd__f3 *areas;    // (N)
  // (N, EXTREMES, 3)
  int8_t *extremes;
  int8_t *latents;  // (N, LATENT)
  // (N) of the patches
  const uint16_t *order;
  int open;
} nsvcd__latents;

// Begins a body in `memory`: zeros, the header, and the padding of the patches' spheres.
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

// Are 16 spheres within a distance of a point, but for roundings? It takes no roots, and compilers
// vectorize it.
static int nsvcd__are_within(nsvcd__spheres all, nsvcd__f3 point, float distance) {
  int are_within = 1;
  for (size_t i = 0; i < NSVCD__GROUP; i++) {
    const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, i), point);
    const float gap = distance - all.r[i];
    are_within &= (gap > 0) & (nsvcd__f3_dot(offset, offset) < gap * gap);
  }
  return are_within;
}

// The distance from a point to the farthest point of `count` spheres. *farthest: a guess, the
// better the faster; becomes the sphere that is farthest, if the distance is above 0.
static float nsvcd__radius_about(nsvcd__spheres all, size_t count, nsvcd__f3 point,
                                 size_t *farthest) {
  const nsvcd__sphere guess = nsvcd__sphere_of(all, *farthest);
  // less than 1 by more than the roundings: the farthest sphere is never skipped
  const float fraction = 0.999998f;
  float least = fraction * (nsvcd__f3_norm(nsvcd__f3_sub(guess.centre, point)) + guess.radius);
  float radius = 0;
  for (size_t first = 0; first < count; first += NSVCD__GROUP) {
    const size_t end = first + nsvcd__group_members(count, first);
    const nsvcd__spheres some = nsvcd__spheres_from(all, first);
    if (end == first + NSVCD__GROUP && nsvcd__are_within(some, point, least)) continue;
    for (size_t i = first; i < end; i++) {
      const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, i), point);
      const float to = nsvcd__f3_norm(offset) + all.r[i];
      if (to > radius) *farthest = i;
      radius = to > radius ? to : radius;
    }
    least = fraction * radius > least ? fraction * radius : least;
  }
  return radius;
}

// A sphere over `count` spheres (Badoiu, Clarkson 2003): ever shorter steps towards the farthest
// sphere. Difference: they begin in the middle of the box, and the best one is kept. The radius is
// rounded up by more than any compiler's rounding.
static nsvcd__sphere nsvcd__cover_spheres(nsvcd__spheres all, size_t count) {
  nsvcd__f3 low = nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF);
  nsvcd__f3 high = nsvcd__f3_scale(low, -1);
  for (size_t i = 0; i < count; i++) {
    const nsvcd__f3 r = nsvcd__f3_of(all.r[i], all.r[i], all.r[i]);
    const nsvcd__f3 centre = nsvcd__centre_of(all, i);
    low = nsvcd__f3_min(low, nsvcd__f3_sub(centre, r));
    high = nsvcd__f3_max(high, nsvcd__f3_add(centre, r));
  }
  const nsvcd__f3 half = nsvcd__f3_scale(low, 0.5f);
  nsvcd__f3 centre = nsvcd__f3_add(half, nsvcd__f3_scale(high, 0.5f));
  nsvcd__sphere best = {centre, HUGE_VALF};
  size_t farthest = 0;
  for (int step = 0; step < 32; step++) {
    const float radius = nsvcd__radius_about(all, count, centre, &farthest);
    const nsvcd__sphere trial = {centre, radius};
    if (trial.radius < best.radius) best = trial;
    const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, farthest), centre);
    const float steps = (float)(step + 3);
    centre.x += offset.x / steps;
    centre.y += offset.y / steps;
    centre.z += offset.z / steps;
  }
  best.radius *= 1.000002f;
  return best;
}

// Fills a level with spheres over 16 of `members` spheres each.
static void nsvcd__cover_level(nsvcd_body *body, size_t k, nsvcd__spheres below,
                               size_t members) {
  const nsvcd__level level = nsvcd__level_of(body->padded, k);
  float *out = (float *)(body + 1) + level.first;
  for (size_t g = 0; g < level.slots; g++) {
    nsvcd__sphere sphere = {{0, 0, 0}, NSVCD__NOWHERE};
    const size_t i = g * NSVCD__GROUP;
    const size_t count = nsvcd__group_members(members, i);
    if (count) sphere = nsvcd__cover_spheres(nsvcd__spheres_from(below, i), count);
    nsvcd__sphere_store(sphere, out, level.slots, g);
  }
}

// Fills in the levels above the groups, the bounding sphere and the extent of a blob whose patches
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
  const float extent = nsvcd__radius_about(patches, body->patches, origin, &farthest);
  nsvcd__f3_store(sphere.centre, body->centre);
  body->radius = sphere.radius;
  body->extent = extent * 1.000002f;
}

// Are the area vectors of a body of latents in range?
static int nsvcd__areas_are_sound(const nsvcd_body *body) {
  return nsvcd__in_range(nsvcd__body_areas(body), 3 * nsvcd__area_slots(body->padded),
                         NSVCD__MAX_LENGTH * NSVCD__MAX_LENGTH);
}

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_NETWORK)
// Builds a body of latents in `memory`, nsvcd_body_size bytes. NUMBER if something is out of range,
// EMPTY if it is too small.
static nsvcd_result nsvcd__body_build(const nsvcd__latents *all, void *memory) {
  const size_t count = all->count;
  nsvcd_body *b = nsvcd__body_begin(memory, nsvcd_body_size(count), count, all->open);
  const size_t padded = b->padded;
  b->weights_id = NSVCD_WEIGHTS_ID;
  float *spheres = (float *)(b + 1);
  float *areas = (float *)nsvcd__writable(b, nsvcd__body_areas(b));
  int8_t *extremes = (int8_t *)nsvcd__writable(b, nsvcd__group_extremes(b, 0));
  int8_t *latents = (int8_t *)nsvcd__writable(b, nsvcd__body_latents(b));
  for (size_t i = 0; i < count; i++) {
    const size_t n = all->order[i];
    const nsvcd__sphere sphere = {all->centres[n], all->radii[n]};
    nsvcd__sphere_store(sphere, spheres, padded, i);
    nsvcd__f3_put(all->areas[n], areas + i, padded);
    const size_t lane = i % NSVCD__GROUP;
    int8_t *group = extremes + 3 * NSVCD__EXTREMES * (i - lane) + lane;
    for (size_t k = 0; k < 3 * NSVCD__EXTREMES; k++)
      group[NSVCD__GROUP * k] = all->extremes[3 * NSVCD__EXTREMES * n + k];
    memcpy(latents, all->latents + NSVCD__LATENT * n, NSVCD__LATENT);
    latents += NSVCD__LATENT;
  }
  // If there are levels above the groups, all levels have sums over what is below.
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
  int sound = nsvcd__in_range(spheres, 3 * padded, NSVCD_MAX_COORDINATE);
  sound = sound && nsvcd__in_range(nsvcd__body_r(b), count, 4 * NSVCD_MAX_COORDINATE);
  if (!sound || !nsvcd__areas_are_sound(b)) return NSVCD_ERROR_NUMBER;
  nsvcd__cover_level(b, 0, nsvcd__body_patches(b), count);
  nsvcd__body_finish(b);
  b->checksum = nsvcd__body_checksum(b);
  return b->radius < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif

// ---------------------------------------------------------------------------------- body/traversal
// In: a body and a filter of spheres. Out: the groups whose spheres pass.

// Which of 16 spheres pass? A bit for each.
typedef uint32_t nsvcd__filter(const void *what, nsvcd__spheres spheres);

// Visits, in order, the groups that pass a filter, as do all spheres over them.
typedef struct nsvcd__traversal {
  const nsvcd_body *body;
  nsvcd__filter *filter;
  const void *what;
  size_t levels, level;
  // on each level: the first of the spheres at hand, and bits of those still to be visited
  uint32_t first[NSVCD__LEVELS], left[NSVCD__LEVELS];
} nsvcd__traversal;

// Filters 16 spheres of a level.
static uint32_t nsvcd__traversal_filter(const nsvcd__traversal *t, size_t level,
                                        size_t first) {
  const nsvcd__level at = nsvcd__level_of(t->body->padded, level);
  const nsvcd__spheres all = nsvcd__level_spheres(t->body, at);
  return t->filter(t->what, nsvcd__spheres_from(all, first));
}

static void nsvcd__traversal_begin(nsvcd__traversal *t, const nsvcd_body *body,
                                   nsvcd__filter *filter, const void *what) {
  t->body = body;
  t->filter = filter;
  t->what = what;
  t->levels = nsvcd__level_count(body->padded);
  t->level = t->levels - 1;
  t->first[t->level] = 0;
  uint32_t left = 0;
  const size_t slots = nsvcd__level_of(body->padded, t->level).slots;
  for (size_t first = 0; first < slots; first += NSVCD__GROUP)
    left |= nsvcd__traversal_filter(t, t->level, first) << first;
  t->left[t->level] = left;
}

// Goes to the next group. 0 if there is none.
static int nsvcd__traversal_next(nsvcd__traversal *t, size_t *group) {
  for (;;) {
    while (!t->left[t->level]) {
      if (t->level + 1 == t->levels) return 0;
      t->level++;
    }
    uint32_t *left = &t->left[t->level];
    const size_t found = t->first[t->level] + nsvcd__low_bit(*left);
    *left &= *left - 1;
    if (t->level == 0) {
      *group = found;
      return 1;
    }
    t->level--;
    t->first[t->level] = (uint32_t)(NSVCD__GROUP * found);
    t->left[t->level] = nsvcd__traversal_filter(t, t->level, NSVCD__GROUP * found);
  }
}

// ----------------------------------------------------------------------------------- body/geometry
// In: the surface of each patch. Out: the proof's blob, and what it says of a patch.
//
// A body of triangles. Its spheres are the least ones about the surface in each patch. Behind them:
//
//   counts          nsvcd__counts
//   box             (2, 3)   float: least and greatest coordinates of the surface
//   widest          (2)      float: the greatest of `errors`; and how far the mesh's vertices are
//                            off, metres: 0, except in bodies that are scaled or coarse
//   slabs           (6, P)   float: normal n, low, high, across: points x of a piece have
//                            low <= n.(x - c) <= high and are within `across` of the line along n
//                            through c, the centre of the patch's sphere
//   group slabs     (6, G)   float: the same over the members of a group; c: its sphere's centre
//   steps           (P)      float: metres per integer: a stored point is c + step (x, y, z)
//   margins         (P)      float: pieces are within this of the hull of the first points
//   errors          (P)      float: corners that are stored points are within this of the mesh's
//   first_vertex, first_own, first_reference, first_triangle, first_byte
//                   (5, N + 1) uint32: where a patch's stored points, the vertices that no patch
//                            before it has, its references to others, its entries and their bytes
//                            begin
//   first_seed      (G' + 1) uint32: where a group's seeds begin; G': groups without padding
//   seeds           (C, 3)   float: a point of each component, group by group, in the group's
//                            sphere
//   positions       (W, 3)   float: the mesh's vertices as the caller gave them, each position
//                            once: first those that patches own, then those of no patch
//   cut             (K)      uint32: the caller's triangles that are stored in pieces, ascending
//   cut_corners     (K, 3)   uint32: their corners, numbers of vertices
//   references      (R)      uint32, or uint16 if W <= 65536: patch by patch, numbers of vertices
//                            that an earlier patch owns
//   vertices        (3 V)    int16: patch by patch x, y, z of its stored points: those of the hull,
//                            then corners of pieces
//                   (16)     int16: padding, so that 16 can be read from any point on
//   entries         (B)      bytes: of each patch's T triangles
//     corners       (T, 3)   uint8, or uint16 in patches of more than 256 points: numbers in the
//                            patch of its stored points, its own vertices, its references. An
//                            entry of vertices alone is a triangle of the caller's; any other is a
//                            piece of one
//     numbers       (T)      each in 1 to 5 bytes: see nsvcd__read_code
//   hull_counts     (N)      uint8: vertices of the hull, at most 16; 0: the patch has no surface

#define NSVCD__HULLS (NSVCD__GROUP * NSVCD__HULL)  // vertices of a group, at most
#define NSVCD__GEOMETRY_BOX 8                      // floats of `box` and `widest`

typedef struct nsvcd__counts {
  // L, entries of all patches
  uint32_t listed;
  // V, stored points
  uint32_t vertices;
  uint32_t components;   // C
  uint32_t entry_bytes;  // B
  // metres that the body extends beyond its triangles
  float convex_radius;
  // W, R, K; all 0: the body is coarse
  uint32_t positions, references, cut;
  // as nsvcd_body_facts tells them
  uint32_t solids, open_solids, open_edges;
  // 1: entries have kinds of two bits
  uint32_t is_mixed;
  // metres: corners this near count as one in what is closed
  float gap;
} nsvcd__counts;

// Where everything is in a body of triangles. Only who builds or scales one writes through this.
typedef struct nsvcd__geometry {
  nsvcd_body *body;
  nsvcd__counts *counts;
  float *box, *slabs, *group_slabs, *steps, *margins, *errors, *seeds, *positions;
  uint32_t *first_vertex, *first_own, *first_reference, *first_triangle, *first_byte;
  uint32_t *first_seed, *cut, *cut_corners;
  unsigned char *references;
  int16_t *vertices;
  unsigned char *entries;
  uint8_t *hull_counts;
  // of each: 2 or 4
  size_t reference_bytes;
  // of an entry's code: 1 or 2
  unsigned kind_bits;
} nsvcd__geometry;

// The body of triangles in a body; NULL: there is none, or it may not be read.
static const nsvcd_body *nsvcd__triangles_of(const nsvcd_body *body) {
  if (!NSVCD__PROOF || body->triangles == 0) return NULL;
  return (const nsvcd_body *)(const void *)((const char *)body + body->inner);
}

static const nsvcd__counts *nsvcd__counts_of(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const nsvcd__counts *)(const void *)at;
}

// The next `count` numbers in a body; NULL: only counts them.
#define NSVCD__PASS(type, count) ((type *)nsvcd__pass(body, &at, count, sizeof(type)))
static void *nsvcd__pass(nsvcd_body *body, uint64_t *at, uint64_t count, size_t size) {
  void *out = body ? (char *)body + *at : NULL;
  *at += count * size;
  return out;
}

// Lays out a body of `patches` patches; NULL: only finds its size. Returns that, or 0 if it takes
// more than 32 bits.
static size_t nsvcd__geometry_layout(nsvcd_body *body, size_t patches,
                                     const nsvcd__counts *counts, nsvcd__geometry *f) {
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t starts = patches + 1;
  uint64_t at = nsvcd__spheres_size(padded);
  f->body = body;
  f->reference_bytes = counts->positions <= 65536 ? 2 : 4;
  f->kind_bits = 1 + (counts->is_mixed != 0);
  f->counts = NSVCD__PASS(nsvcd__counts, 1);
  f->box = NSVCD__PASS(float, NSVCD__GEOMETRY_BOX);
  f->slabs = NSVCD__PASS(float, 6 * padded);
  f->group_slabs = NSVCD__PASS(float, 6 * nsvcd__group_slots(padded));
  f->steps = NSVCD__PASS(float, padded);
  f->margins = NSVCD__PASS(float, padded);
  f->errors = NSVCD__PASS(float, padded);
  f->first_vertex = NSVCD__PASS(uint32_t, starts);
  f->first_own = NSVCD__PASS(uint32_t, starts);
  f->first_reference = NSVCD__PASS(uint32_t, starts);
  f->first_triangle = NSVCD__PASS(uint32_t, starts);
  f->first_byte = NSVCD__PASS(uint32_t, starts);
  f->first_seed = NSVCD__PASS(uint32_t, padded / NSVCD__GROUP + 1);
  f->seeds = NSVCD__PASS(float, (uint64_t)3 * counts->components);
  f->positions = NSVCD__PASS(float, (uint64_t)3 * counts->positions);
  f->cut = NSVCD__PASS(uint32_t, counts->cut);
  f->cut_corners = NSVCD__PASS(uint32_t, (uint64_t)3 * counts->cut);
  const uint64_t references = (uint64_t)f->reference_bytes * counts->references;
  f->references = NSVCD__PASS(unsigned char, references);
  f->vertices = NSVCD__PASS(int16_t, (uint64_t)3 * counts->vertices + NSVCD__LANES);
  f->entries = NSVCD__PASS(unsigned char, counts->entry_bytes);
  f->hull_counts = NSVCD__PASS(uint8_t, patches);
  at += NSVCD_ALIGNMENT - at % NSVCD_ALIGNMENT;
  return at > 0xffffffffu ? 0 : (size_t)at;
}

static nsvcd__geometry nsvcd__geometry_of(const nsvcd_body *body) {
  nsvcd__geometry f;
  nsvcd_body *b;
  // a cast would take away a const
  memcpy(&b, &body, sizeof b);
  (void)nsvcd__geometry_layout(b, body->patches, nsvcd__counts_of(body), &f);
  return f;
}

static float nsvcd__widest_error(const nsvcd__geometry *f) {
  return f->box[6];
}
// How far nsvcd__patch_triangle may be off the mesh's triangle.
static float nsvcd__off_mesh(const nsvcd__geometry *f) {
  return f->box[7];
}

// ---- one patch

// The stored points of a patch: integers, in steps from its centre.
typedef struct nsvcd__vertices {
  const int16_t *x, *y, *z;
  size_t count;
} nsvcd__vertices;

NSVCD__INLINE nsvcd__vertices nsvcd__vertices_of(const nsvcd__geometry *f, size_t patch) {
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

// A patch numbers the points that its corners can be: stored points, then own vertices, then
// references. These are their counts.
typedef struct nsvcd__patch_points {
  size_t stored, own, all;
} nsvcd__patch_points;

NSVCD__INLINE nsvcd__patch_points nsvcd__points_of(const nsvcd__geometry *f, size_t patch) {
  nsvcd__patch_points out;
  out.stored = f->first_vertex[patch + 1] - f->first_vertex[patch];
  out.own = f->first_own[patch + 1] - f->first_own[patch];
  const uint32_t *references = f->first_reference + patch;
  out.all = out.stored + out.own + references[1] - references[0];
  return out;
}

// Bytes of a corner in a patch of `points` points.
static size_t nsvcd__corner_bytes(size_t points) {
  return points <= 256 ? 1 : 2;
}

// The vertex that reference n names.
NSVCD__INLINE size_t nsvcd__reference_at(const nsvcd__geometry *f, size_t n) {
  uint32_t number;
  uint16_t narrow;
  if (f->reference_bytes == 4) {
    memcpy(&number, f->references + 4 * n, sizeof number);
    return number;
  }
  memcpy(&narrow, f->references + 2 * n, sizeof narrow);
  return narrow;
}

// The position of point i of a patch, not a stored one: (3).
NSVCD__INLINE const float *nsvcd__position_of(const nsvcd__geometry *f, size_t patch,
                                              nsvcd__patch_points points, size_t i) {
  i -= points.stored;
  if (i < points.own) return f->positions + 3 * (f->first_own[patch] + i);
  const size_t at = f->first_reference[patch] + i - points.own;
  return f->positions + 3 * nsvcd__reference_at(f, at);
}

// The number, in the patch, of corner k (0..2) of entry n.
static size_t nsvcd__triangle_corner(const nsvcd__geometry *f, size_t patch, size_t n,
                                     size_t k) {
  const unsigned char *corners = f->entries + f->first_byte[patch];
  const size_t at = 3 * (n - f->first_triangle[patch]) + k;
  if (nsvcd__corner_bytes(nsvcd__points_of(f, patch).all) == 1) return corners[at];
  uint16_t corner;
  memcpy(&corner, corners + 2 * at, sizeof corner);
  return corner;
}

// The numbers of entries follow each other as codes. The upper bits of a code are the triangle's
// number in the caller's mesh minus that of the entry before, modulo 2^30. The lowest bit tells
// whether it belongs to a closed component; in a body with other kinds than CLOSED and SHEET, the
// lowest two are the kind. A code has 7 bits a byte, the lowest first; the top bit tells that more
// follow. Most codes take one byte, for neighbours have near numbers.
static uint32_t nsvcd__read_code(const unsigned char **at) {
  uint32_t code = 0;
  for (unsigned shift = 0; shift < 35; shift += 7) {
    const uint32_t byte = *(*at)++;
    code |= (byte & 0x7f) << shift;
    if (!(byte & 0x80)) break;
  }
  return code;
}

// Reads the numbers of a patch's entries, one after another.
typedef struct nsvcd__numbers {
  const unsigned char *at;
  size_t next;  // entry
  // of the entry before
  uint32_t number, kind;
  unsigned kind_bits;
} nsvcd__numbers;

static nsvcd__numbers nsvcd__numbers_of(const nsvcd__geometry *f, size_t patch) {
  const size_t bytes = nsvcd__corner_bytes(nsvcd__points_of(f, patch).all);
  const size_t triangles = f->first_triangle[patch + 1] - f->first_triangle[patch];
  nsvcd__numbers out;
  out.at = f->entries + f->first_byte[patch] + 3 * triangles * bytes;
  out.next = f->first_triangle[patch];
  out.number = 0;
  out.kind = NSVCD__SHEET;
  out.kind_bits = f->kind_bits;
  return out;
}

// Reads on up to entry n, which has not been read yet.
static void nsvcd__read_number(nsvcd__numbers *numbers, size_t n) {
  for (; numbers->next <= n; numbers->next++) {
    const uint32_t code = nsvcd__read_code(&numbers->at);
    const unsigned bits = numbers->kind_bits;
    numbers->number = (numbers->number + (code >> bits)) & NSVCD__NUMBER;
    numbers->kind = bits == 1 ? (code & 1) * NSVCD__CLOSED : code & 3;
  }
}

// The caller's triangle of entry n.
static uint32_t nsvcd__triangle_number(const nsvcd__geometry *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.number;
}

// Does entry n belong to a closed surface?
static inline int nsvcd__is_in_solid(const nsvcd__geometry *f, size_t patch, size_t n) {
  nsvcd__numbers numbers = nsvcd__numbers_of(f, patch);
  nsvcd__read_number(&numbers, n);
  return numbers.kind >= NSVCD__CLOSED && !f->body->open;
}

static nsvcd__f3 nsvcd__patch_centre(const nsvcd__geometry *f, size_t patch) {
  return nsvcd__centre_of(nsvcd__body_patches(f->body), patch);
}
// The same in double: the origin of the stored points.
static nsvcd__d3 nsvcd__patch_origin(const nsvcd__geometry *f, size_t patch) {
  return nsvcd__d3_widen(nsvcd__patch_centre(f, patch));
}

// Stored point i of a patch.
static nsvcd__d3 nsvcd__stored_point(const nsvcd__geometry *f, size_t patch, size_t i) {
  const nsvcd__vertices vertices = nsvcd__vertices_of(f, patch);
  const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, i);
  return nsvcd__d3_fma((double)f->steps[patch], vertex, nsvcd__patch_origin(f, patch));
}

// The corners (3) of a triangle of the caller's that is stored in pieces.
static void nsvcd__whole_triangle(const nsvcd__geometry *f, uint32_t number,
                                  nsvcd__d3 *corners) {
  size_t first = 0;
  for (size_t left = f->counts->cut; left > 1;) {
    const size_t half = left / 2;
    if (f->cut[first + half] <= number) first += half;
    left -= half;
  }
  for (size_t k = 0; k < 3; k++)
    corners[k] = nsvcd__d3_row(f->positions, f->cut_corners[3 * first + k]);
}

// The corners (3) of the caller's triangle that entry n is, or is a piece of. In a coarse body
// those of the entry itself.
static inline void nsvcd__patch_triangle(const nsvcd__geometry *f, size_t patch, size_t n,
                                         nsvcd__d3 *corners) {
  const nsvcd__patch_points points = nsvcd__points_of(f, patch);
  for (size_t k = 0; k < 3; k++) {
    const size_t i = nsvcd__triangle_corner(f, patch, n, k);
    if (i >= points.stored) {
      corners[k] = nsvcd__d3_load(nsvcd__position_of(f, patch, points, i));
    } else if (f->counts->cut > 0) {
      nsvcd__whole_triangle(f, nsvcd__triangle_number(f, patch, n), corners);
      return;
    } else {
      corners[k] = nsvcd__stored_point(f, patch, i);
    }
  }
}

// ---- what follows from the patches

typedef struct nsvcd__dslab {
  double low, high, across;
} nsvcd__dslab;

// The extent of a group along a direction and across it, from the centre of its sphere. Stops once
// that is no thinner than `most`.
static nsvcd__dslab nsvcd__slab_of_group(const nsvcd__geometry *f, size_t g, nsvcd__d3 normal,
                                         double most) {
  const size_t first = NSVCD__GROUP * g;
  const nsvcd__spheres groups = nsvcd__groups_of(f->body);
  const nsvcd__d3 centre = nsvcd__d3_widen(nsvcd__centre_of(groups, g));
  nsvcd__dslab slab = {HUGE_VAL, -HUGE_VAL, 0};
  for (size_t i = first; i < first + NSVCD__GROUP && i < f->body->patches; i++) {
    if (slab.high - slab.low >= most) break;
    const nsvcd__vertices vertices = nsvcd__vertices_of(f, i);
    const nsvcd__d3 own = nsvcd__d3_sub(nsvcd__patch_origin(f, i), centre);
    const double step = (double)f->steps[i];
    const double margin = (double)f->margins[i];
    double farthest = 0;
    for (size_t k = 0; k < f->hull_counts[i]; k++) {
      const nsvcd__d3 vertex = nsvcd__vertex_at(&vertices, k);
      const nsvcd__d3 v = nsvcd__d3_fma(step, vertex, own);
      const double height = nsvcd__d3_dot(normal, v);
      farthest = nsvcd__max(farthest, nsvcd__d3_dot(v, v) - height * height);
      slab.low = nsvcd__min(slab.low, height - margin);
      slab.high = nsvcd__max(slab.high, height + margin);
    }
    if (f->hull_counts[i]) slab.across = nsvcd__max(slab.across, sqrt(farthest) + margin);
  }
  return slab;
}

// Writes a group's slab. Its normal is the mean of the members' normals, or that of every fourth
// member, whichever makes it thinnest.
static void nsvcd__finish_group(nsvcd_body *b, size_t g) {
  const nsvcd__geometry f = nsvcd__geometry_of(b);
  nsvcd__d3 normals[1 + NSVCD__GROUP] = {{0, 0, 0}};
  for (size_t k = 0; k < NSVCD__GROUP; k++) {
    const float *n = f.slabs + NSVCD__GROUP * g + k;
    const nsvcd__d3 normal = nsvcd__d3_widen(nsvcd__f3_get(n, b->padded));
    normals[1 + k] = normal;
    const double sign = nsvcd__d3_dot(normal, normals[1]) < 0 ? -1 : 1;
    normals[0] = nsvcd__d3_fma(sign, normal, normals[0]);
  }
  nsvcd__d3 best = {0, 0, 1};
  nsvcd__dslab thinnest = {0, HUGE_VAL, 0};
  for (size_t k = 0; k < 1 + NSVCD__GROUP; k += k == 0 ? 1 : 4) {
    const double length = nsvcd__d3_norm(normals[k]);
    if (!(length > 1e-3)) continue;
    // as it is stored, and not longer than 1
    const nsvcd__d3 shorter = nsvcd__d3_scale(normals[k], 0.9999998 / length);
    const nsvcd__d3 unit = nsvcd__d3_widen(nsvcd__f3_round(shorter));
    const double most = thinnest.high - thinnest.low;
    const nsvcd__dslab slab = nsvcd__slab_of_group(&f, g, unit, most);
    if (!(slab.high - slab.low < most)) continue;
    thinnest = slab;
    best = unit;
  }
  // rounding to float; and `across` assumes |n| = 1
  const double margin = 1e-6 * (double)b->extent;
  nsvcd__slab slab;
  slab.normal = nsvcd__f3_round(best);
  slab.low = (float)(thinnest.low - margin);
  slab.high = thinnest.high < HUGE_VAL ? (float)(thinnest.high + margin) : 0;
  slab.across = nsvcd__above(thinnest.across + margin);
  nsvcd__slab_store(slab, f.group_slabs, nsvcd__group_slots(b->padded), g);
}

// Spheres about the hulls' vertices, which together contain the surface of a group. A patch without
// surface is a point.
typedef struct nsvcd__hulls {
  size_t count;
  // x, y, z, r
  float spheres[4][NSVCD__HULLS];
} nsvcd__hulls;

static void nsvcd__collect_hulls(const nsvcd__geometry *f, size_t g, nsvcd__hulls *out) {
  const size_t end = NSVCD__GROUP * (g + 1);
  out->count = 0;
  for (size_t i = end - NSVCD__GROUP; i < end && i < f->body->patches; i++) {
    const size_t count = f->hull_counts[i];
    for (size_t k = 0; k < count + !count; k++) {
      nsvcd__d3 v = nsvcd__patch_origin(f, i);
      if (count) v = nsvcd__stored_point(f, i, k);
      // of v to float
      const double rounding = 1.1e-7 * nsvcd__d3_norm(v);
      const size_t n = out->count++;
      out->spheres[3][n] = nsvcd__above((double)f->margins[i] + rounding);
      nsvcd__f3_put(nsvcd__f3_round(v), &out->spheres[0][n], NSVCD__HULLS);
    }
  }
}

static nsvcd__spheres nsvcd__hull_spheres(const nsvcd__hulls *hulls) {
  return nsvcd__spheres_of(hulls->spheres[0], NSVCD__HULLS);
}

// Completes a body of triangles whose patches are in place: spheres of groups and levels, the box,
// the greatest error, the groups' slabs. off: of the mesh's vertices, metres.
static void nsvcd__geometry_finish(nsvcd_body *b, float off) {
  const nsvcd__geometry f = nsvcd__geometry_of(b);
  const nsvcd__level groups = nsvcd__level_of(b->padded, 0);
  float *out = (float *)(b + 1) + groups.first;
  for (size_t g = 0; g < groups.slots; g++) {
    nsvcd__sphere over = {{0, 0, 0}, NSVCD__NOWHERE};
    nsvcd__hulls hulls;
    if (g < groups.count) {
      nsvcd__collect_hulls(&f, g, &hulls);
      over = nsvcd__cover_spheres(nsvcd__hull_spheres(&hulls), hulls.count);
    }
    nsvcd__sphere_store(over, out, groups.slots, g);
  }
  nsvcd__body_finish(b);
  const nsvcd__d3 all = {1, 1, 1};
  nsvcd__d3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  nsvcd__d3 high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  float widest = 0;
  for (size_t n = 0; n < f.counts->positions; n++) {
    low = nsvcd__d3_min(low, nsvcd__d3_row(f.positions, n));
    high = nsvcd__d3_max(high, nsvcd__d3_row(f.positions, n));
  }
  for (size_t i = 0; i < b->patches; i++) {
    const size_t count = f.first_vertex[i + 1] - f.first_vertex[i];
    const double error = (double)f.errors[i];
    widest = f.errors[i] > widest ? f.errors[i] : widest;
    for (size_t k = 0; k < count && f.counts->positions == 0; k++) {
      const nsvcd__d3 vertex = nsvcd__stored_point(&f, i, k);
      low = nsvcd__d3_min(low, nsvcd__d3_fma(-error, all, vertex));
      high = nsvcd__d3_max(high, nsvcd__d3_fma(error, all, vertex));
    }
  }
  // 1e-6: rounding to float
  const double margin = 1e-6 * (double)b->extent + (double)off;
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(-margin, all, low)), f.box);
  nsvcd__f3_store(nsvcd__d3_narrow(nsvcd__d3_fma(margin, all, high)), f.box + 3);
  f.box[6] = widest;
  f.box[7] = f.counts->positions > 0 ? off : widest;
  for (size_t g = 0; g < nsvcd__body_groups(b); g++) nsvcd__finish_group(b, g);
  b->checksum = nsvcd__body_checksum(b);
}

// The radius of a body's sphere, its convex radius included.
static float nsvcd__whole_radius(const nsvcd_body *body) {
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  return body->radius + (triangles ? nsvcd__counts_of(triangles)->convex_radius : 0);
}

// -------------------------------------------------------------------------------------- body/trust
// In: bytes of any origin. Out: a body, if nsvcd_encode could have written them.

// ---- spheres: both kinds of bodies begin with them

// Does a sphere contain `count` spheres?
static int nsvcd__covers(nsvcd__sphere sphere, nsvcd__spheres all, size_t count) {
  size_t farthest = 0;
  return nsvcd__radius_about(all, count, sphere.centre, &farthest) <= sphere.radius;
}

// Are the first `count` of (4, slots) spheres finite and in range, with no negative radius, and the
// others padding? most: of the coordinates.
static int nsvcd__are_spheres(nsvcd__spheres all, size_t count, size_t slots, float most) {
  int ok = nsvcd__in_range(all.x, 3 * slots, most) &&
           nsvcd__in_range(all.r, count, NSVCD__MAX_LENGTH) &&
           nsvcd__in_range(all.r, slots, -NSVCD__NOWHERE);
  for (size_t i = 0; ok && i < count; i++) ok = all.r[i] >= 0;
  for (size_t i = count; ok && i < slots; i++) {
    ok = all.r[i] == NSVCD__NOWHERE;
    ok &= all.x[i] == 0 && all.y[i] == 0 && all.z[i] == 0;
  }
  return ok;
}

// Does each of a level's spheres contain its 16 of `members` spheres below?
static int nsvcd__level_covers(nsvcd__spheres level, nsvcd__spheres below, size_t members) {
  int ok = 1;
  for (size_t i = 0; ok && i < members; i += NSVCD__GROUP) {
    const size_t count = nsvcd__group_members(members, i);
    const nsvcd__sphere sphere = nsvcd__sphere_of(level, i / NSVCD__GROUP);
    ok = nsvcd__covers(sphere, nsvcd__spheres_from(below, i), count);
  }
  return ok;
}

// Are the spheres of a blob with a sound header in range, and does each one above the groups
// contain what is below it? The checksum catches accidents; this catches blobs made to harm: a
// wrong sphere would hide collisions.
static int nsvcd__spheres_are_sound(const nsvcd_body *b) {
  const float most = NSVCD__MAX_LENGTH;
  const nsvcd__spheres patches = nsvcd__body_patches(b);
  const nsvcd__spheres groups = nsvcd__groups_of(b);
  nsvcd__spheres below = groups;
  size_t members = 0;
  int ok = nsvcd__are_spheres(patches, b->patches, b->padded, NSVCD_MAX_COORDINATE) &&
           nsvcd__in_range(b->centre, 3, most) && nsvcd__in_range(&b->radius, 1, most) &&
           nsvcd__in_range(&b->extent, 1, most) && b->radius >= 0;
  for (size_t k = 0; ok && k < nsvcd__level_count(b->padded); k++) {
    const nsvcd__level level = nsvcd__level_of(b->padded, k);
    const nsvcd__spheres above = nsvcd__level_spheres(b, level);
    ok = nsvcd__are_spheres(above, level.count, level.slots, most) &&
         nsvcd__level_covers(above, below, members);
    below = above;
    members = level.count;
  }
  const nsvcd__sphere whole = nsvcd__body_sphere(b);
  const nsvcd__sphere about_origin = {{0, 0, 0}, b->extent};
  return ok && nsvcd__covers(about_origin, patches, b->patches) &&
         (nsvcd__covers(whole, patches, b->patches) ||
          nsvcd__covers(whole, groups, nsvcd__body_groups(b)));
}

// Would the scaled spheres still be within the limits of nsvcd_body_load? In double, for the
// products may overflow a float.
static int nsvcd__spheres_fit(const nsvcd_body *b, float radius, float scale) {
  const double least = (double)NSVCD_MIN_RADIUS / (double)scale;
  const double most = (double)NSVCD_MAX_COORDINATE / (double)scale;
  if ((double)radius < least) return 0;
  for (size_t i = 0; i < 3 * (size_t)b->padded; i++) {
    if (fabs((double)nsvcd__body_patches(b).x[i]) > most) return 0;
  }
  // no radius or centre of a group exceeds twice the extent
  return 2 * (double)b->extent <= (double)NSVCD__MAX_LENGTH / (double)scale;
}

#ifndef NSVCD_NO_NETWORK
// Are the extremes in range, and is their padding zero?
static int nsvcd__extremes_are_sound(const nsvcd_body *b) {
  const int8_t *extremes = nsvcd__group_extremes(b, 0);
  for (size_t n = 0; n < (size_t)3 * NSVCD__EXTREMES * b->padded; n++) {
    const size_t group = n / (3 * NSVCD__EXTREMES * NSVCD__GROUP);
    const int exists = NSVCD__GROUP * group + n % NSVCD__GROUP < b->patches;
    if (extremes[n] == -128 || (!exists && extremes[n] != 0)) return 0;
  }
  return 1;
}
#endif

// ---- the triangles

// Do `count` + 1 numbers rise from 0 to `last`?
static int nsvcd__rise(const uint32_t *first, size_t count, size_t last) {
  int rise = first[0] == 0 && first[count] == last;
  for (size_t i = 0; i < count; i++) rise &= first[i] <= first[i + 1];
  return rise;
}

// Do all arrays of patches, groups and numbers of vertices stay within each other?
static int nsvcd__are_laid_out(const nsvcd__geometry *f) {
  const nsvcd__counts *n = f->counts;
  const nsvcd_body *b = f->body;
  const size_t patches = b->patches;
  const size_t own = f->first_own[patches];
  int ok = own <= n->positions && nsvcd__rise(f->first_own, patches, own) &&
           nsvcd__rise(f->first_vertex, patches, n->vertices) &&
           nsvcd__rise(f->first_reference, patches, n->references) &&
           nsvcd__rise(f->first_triangle, patches, n->listed) &&
           nsvcd__rise(f->first_byte, patches, n->entry_bytes) &&
           nsvcd__rise(f->first_seed, nsvcd__body_groups(b), n->components);
  for (size_t i = 0; ok && i < n->references; i++)
    ok = nsvcd__reference_at(f, i) < n->positions;
  for (size_t i = 0; ok && i < n->cut; i++)
    ok = f->cut[i] < b->triangles && (i == 0 || f->cut[i] > f->cut[i - 1]);
  for (size_t i = 0; ok && i < 3 * (size_t)n->cut; i++) ok = f->cut_corners[i] < n->positions;
  return ok;
}

// Are the entries of patch i sound?
static int nsvcd__patch_is_sound(const nsvcd__geometry *f, size_t i) {
  const nsvcd__patch_points points = nsvcd__points_of(f, i);
  const size_t triangle = f->first_triangle[i];
  const size_t triangles = f->first_triangle[i + 1] - triangle;
  const size_t hull_count = f->hull_counts[i];
  if (hull_count > NSVCD__HULL || hull_count > points.stored) return 0;
  if ((hull_count == 0) != (triangles == 0)) return 0;
  if ((hull_count == 0) != (points.all == 0)) return 0;

  const uint64_t corners = (uint64_t)3 * triangles * nsvcd__corner_bytes(points.all);
  const uint64_t corners_end = f->first_byte[i] + corners;
  if (corners_end > f->first_byte[i + 1]) return 0;
  for (size_t n = 0; n < 3 * triangles; n++) {
    if (nsvcd__triangle_corner(f, i, triangle + n / 3, n % 3) >= points.all) return 0;
  }
  // as many codes follow, of triangles that exist, and nothing else
  const unsigned char *at = f->entries + (size_t)corners_end;
  const unsigned char *end = f->entries + f->first_byte[i + 1];
  uint32_t number = 0;
  for (size_t n = 0; n < triangles; n++) {
    const size_t left = (size_t)(end - at);
    size_t bytes = 1;
    while (bytes < 5 && bytes < left && at[bytes - 1] & 0x80) bytes++;
    if (at >= end || at[bytes - 1] & 0x80) return 0;
    number = (number + (nsvcd__read_code(&at) >> f->kind_bits)) & NSVCD__NUMBER;
    if (number >= f->body->triangles) return 0;
  }
  return at == end;
}

// ---- whole bodies

// Are the sizes in a blob's header right, and is it at most `size` bytes long?
static int nsvcd__header_is_sound(const nsvcd_body *b, size_t size) {
  return size >= sizeof *b && b->magic == NSVCD__BODY_MAGIC &&
         b->version == NSVCD__BODY_VERSION && b->patches >= 1 &&
         b->patches <= NSVCD_MAX_PATCHES && b->open <= 1 && b->size <= size &&
         b->padded == nsvcd__round_up(b->patches, NSVCD__GROUP) &&
         b->size >= nsvcd__spheres_size(b->padded) && b->size % NSVCD_ALIGNMENT == 0;
}

// Are the numbers of a body of triangles in range?
static int nsvcd__are_in_range(const nsvcd__geometry *f) {
  const nsvcd__counts *n = f->counts;
  const size_t padded = f->body->padded;
  const size_t slots = nsvcd__group_slots(padded);
  const float most = NSVCD__MAX_LENGTH;
  int ok = nsvcd__in_range(f->box, NSVCD__GEOMETRY_BOX, most) &&
           nsvcd__in_range(f->slabs, 3 * padded, 1.000001f) &&
           nsvcd__in_range(f->slabs + 3 * padded, 3 * padded, most) &&
           nsvcd__in_range(f->group_slabs, 3 * slots, 1.000001f) &&
           nsvcd__in_range(f->group_slabs + 3 * slots, 3 * slots, most) &&
           nsvcd__in_range(f->steps, padded, most / 32768) &&
           nsvcd__in_range(f->margins, padded, most) &&
           nsvcd__in_range(f->errors, padded, nsvcd__widest_error(f)) &&
           nsvcd__in_range(f->seeds, 3 * (size_t)n->components, most) &&
           nsvcd__in_range(f->positions, 3 * (size_t)n->positions, most) &&
           nsvcd__off_mesh(f) >= 0;
  for (size_t i = 0; ok && i < padded; i++) {
    const nsvcd__slab slab = nsvcd__slab_at(f->slabs, padded, i);
    ok = slab.across >= 0 && f->steps[i] >= 0 && f->margins[i] >= 0 && f->errors[i] >= 0;
  }
  return ok;
}

// Is a body of triangles sound, if its header is? Checks the spheres, the layout (sizes, counts and
// indices), and that numbers are in range: they may misstate the surface, but nothing computed from
// them overflows. size: bytes, at most.
static int nsvcd__triangles_are_sound(const nsvcd_body *b, size_t size) {
  const nsvcd__counts *n = nsvcd__counts_of(b);
  const uint64_t counted = nsvcd__spheres_size(b->padded) + sizeof *n;
  nsvcd__geometry f;
  if (b->inner != 0 || b->triangles == 0 || !nsvcd__spheres_are_sound(b)) return 0;
  if (counted > size || n->open_solids > n->solids || n->is_mixed > 1) return 0;
  if (!nsvcd__is_length(n->gap) || !nsvcd__is_length(n->convex_radius)) return 0;
  if (b->radius + n->convex_radius < NSVCD_MIN_RADIUS) return 0;
  const size_t needed = nsvcd__geometry_layout(NULL, b->patches, n, &f);
  if (b->size != needed || b->size > size) return 0;
  f = nsvcd__geometry_of(b);
  int ok = nsvcd__are_laid_out(&f) && nsvcd__are_in_range(&f);
  for (size_t i = 0; ok && i < b->patches; i++) ok = nsvcd__patch_is_sound(&f, i);
  for (size_t g = 0; ok && g < nsvcd__body_groups(b); g++) {
    nsvcd__hulls hulls;
    nsvcd__collect_hulls(&f, g, &hulls);
    const nsvcd__spheres all = nsvcd__hull_spheres(&hulls);
    const nsvcd__sphere over = nsvcd__sphere_of(nsvcd__groups_of(b), g);
    ok = nsvcd__covers(over, all, hulls.count);
  }
  return ok;
}

// Is a body sound, if its header and its checksum are?
static int nsvcd__body_is_sound(const nsvcd_body *b) {
  if (b->weights_id == 0) return NSVCD__PROOF && nsvcd__triangles_are_sound(b, b->size);
  if (b->size < nsvcd__latents_begin(b->padded)) return 0;
  if (!nsvcd__spheres_are_sound(b) || !nsvcd__areas_are_sound(b)) return 0;
  if (b->radius < NSVCD_MIN_RADIUS) return 0;
  if (!nsvcd__level_covers(nsvcd__groups_of(b), nsvcd__body_patches(b), b->patches)) return 0;
#ifndef NSVCD_NO_NETWORK
  if (b->weights_id != NSVCD_WEIGHTS_ID) return 0;
  const size_t latents = nsvcd_body_size(b->patches);
  if (b->size < latents || !nsvcd__extremes_are_sound(b)) return 0;
  if (b->inner == 0) return b->size == latents && b->triangles == 0;
  if (b->inner != latents) return 0;
#else
  if (b->inner % NSVCD_ALIGNMENT || b->inner >= b->size) return 0;
  if (b->inner < nsvcd__latents_begin(b->padded)) return 0;
#endif
  const char *at = (const char *)b + b->inner;
  const nsvcd_body *inner = (const nsvcd_body *)(const void *)at;
  const size_t left = b->size - b->inner;
  return nsvcd__header_is_sound(inner, left) && inner->size == left &&
         inner->weights_id == 0 && inner->open == b->open && inner->patches == b->patches &&
         inner->triangles == b->triangles &&
         (!NSVCD__PROOF || nsvcd__triangles_are_sound(inner, left));
}

// Is this a body, by its header? If it does not begin as one (a text, a nsvcd_mesh), no more than
// its first eight bytes are read.
static nsvcd_result nsvcd__body_check(const nsvcd_body *b, size_t size) {
  if (!b) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__is_aligned(b) || size < sizeof b->magic + sizeof b->version)
    return NSVCD_ERROR_BODY;
  if (b->magic == NSVCD__OTHER_MAGIC) return NSVCD_ERROR_VERSION;
  if (b->magic != NSVCD__BODY_MAGIC) return NSVCD_ERROR_BODY;
  if (b->version != NSVCD__BODY_VERSION) return NSVCD_ERROR_VERSION;
  if (!nsvcd__header_is_sound(b, size)) return NSVCD_ERROR_BODY;
#ifndef NSVCD_NO_NETWORK
  if (b->weights_id && b->weights_id != NSVCD_WEIGHTS_ID) return NSVCD_ERROR_VERSION;
#endif
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body) {
  const nsvcd_body *b = (const nsvcd_body *)memory;
  if (!body) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result result = nsvcd__body_check(b, size);
  if (!result) *body = b;
  return result;
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

static void nsvcd__scale_spheres(nsvcd_body *b, float scale) {
  float *spheres = (float *)(b + 1);
  for (size_t i = 0; i < 3 * (size_t)b->padded + b->patches; i++) spheres[i] *= scale;
}

// Scales a body of latents, without the body of triangles in it.
static void nsvcd__scale_latents(nsvcd_body *b, float scale) {
  float *areas = (float *)nsvcd__writable(b, nsvcd__body_areas(b));
  nsvcd__scale_spheres(b, scale);
  for (size_t i = 0; i < 3 * nsvcd__area_slots(b->padded); i++) {
    areas[i] *= scale;
    areas[i] *= scale;
  }
  nsvcd__cover_level(b, 0, nsvcd__body_patches(b), b->patches);
  nsvcd__body_finish(b);
  b->checksum = nsvcd__body_checksum(b);
}

// Scales a body of triangles. What rounding does to vertices and to the convex radius widens the
// margins and errors, and is what vertices are off by.
static void nsvcd__scale_triangles(nsvcd_body *b, float scale) {
  const nsvcd__geometry f = nsvcd__geometry_of(b);
  const double by = (double)scale;
  float *radius = &f.counts->convex_radius;
  const double exact = (double)*radius * by;
  nsvcd__scale_spheres(b, scale);
  *radius *= scale;
  const double off = fabs(exact - (double)*radius);
  if (f.counts->gap > 0) f.counts->gap = nsvcd__above((double)f.counts->gap * by);
  double worst = off;
  for (size_t i = 0; i < 3 * (size_t)f.counts->positions; i++) {
    const double whole = (double)f.positions[i] * by;
    f.positions[i] *= scale;
    worst = nsvcd__max(worst, 1.8 * fabs(whole - (double)f.positions[i]) + off);
  }
  const double off_mesh = worst + (double)nsvcd__off_mesh(&f) * by;
  for (size_t i = 0; i < b->patches; i++) {
    const double distance = (double)nsvcd__f3_norm(nsvcd__patch_centre(&f, i));
    nsvcd__slab slab = nsvcd__slab_at(f.slabs, b->padded, i);
    f.steps[i] *= scale;
    const double rounding = 2e-7 * (distance + 6e4 * (double)f.steps[i]) + off;
    f.margins[i] = nsvcd__above((double)f.margins[i] * by + rounding);
    f.errors[i] = nsvcd__above((double)f.errors[i] * by + rounding + worst);
    slab.low = (float)((double)slab.low * by - rounding);
    slab.high = (float)((double)slab.high * by + rounding);
    slab.across = nsvcd__above((double)slab.across * by + rounding);
    nsvcd__slab_store(slab, f.slabs, b->padded, i);
  }
  for (size_t i = 0; i < 3 * (size_t)f.counts->components; i++) f.seeds[i] *= scale;
  nsvcd__geometry_finish(b, off_mesh > 0 ? nsvcd__above(off_mesh) : 0);
}

NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, float scale, void *memory,
                                       size_t capacity, const nsvcd_body **scaled) {
  if (!memory || !scaled) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result result = nsvcd__body_check(body, SIZE_MAX);
  if (result) return result;
  if (!nsvcd__is_finite(scale) || scale <= 0) return NSVCD_ERROR_SCALE;
  if (capacity < body->size || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  // else the triangles would keep their size, and loading did not check them
  if (!NSVCD__PROOF && body->triangles) return NSVCD_ERROR_TRIANGLES;
  const float radius = nsvcd__whole_radius(body);
  if (!nsvcd__spheres_fit(body, radius, scale)) return NSVCD_ERROR_SCALE;
  const double most = (double)NSVCD__MAX_LENGTH / (double)scale;
  const size_t numbers = body->weights_id ? 3 * nsvcd__area_slots(body->padded) : 0;
  for (size_t i = 0; i < numbers; i++) {
    if (fabs((double)nsvcd__body_areas(body)[i]) > most * most) return NSVCD_ERROR_SCALE;
  }
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles && !nsvcd__spheres_fit(triangles, radius, scale)) return NSVCD_ERROR_SCALE;
  // may be in place
  memmove(memory, body, body->size);
  nsvcd_body *b = (nsvcd_body *)memory;
  void *inner = (char *)memory + b->inner;
  if (triangles) nsvcd__scale_triangles((nsvcd_body *)inner, scale);
  if (b->weights_id) nsvcd__scale_latents(b, scale);
  *scaled = b;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body) {
  nsvcd_body_facts facts;
  memset(&facts, 0, sizeof facts);
  if (nsvcd__body_check(body, SIZE_MAX)) return facts;
  facts.size = body->size;
  facts.patches = body->patches;
  memcpy(facts.centre, body->centre, sizeof facts.centre);
  facts.radius = nsvcd__whole_radius(body);
  facts.extent = body->extent;
  facts.latents = body->weights_id != 0;
  facts.open = (int)body->open;
  for (size_t i = 0; i < body->patches; i++)
    facts.mean_patch_radius += nsvcd__body_r(body)[i] / (float)body->patches;
  const nsvcd_body *triangles = nsvcd__triangles_of(body);
  if (triangles) {
    const nsvcd__geometry f = nsvcd__geometry_of(triangles);
    facts.triangles = triangles->triangles;
    facts.stored_triangles = f.counts->listed;
    memcpy(facts.low, f.box, sizeof facts.low);
    memcpy(facts.high, f.box + 3, sizeof facts.high);
    facts.quantization_error = nsvcd__off_mesh(&f);
    facts.convex_radius = f.counts->convex_radius;
    facts.components = f.counts->solids;
    facts.open_components = f.counts->open_solids;
    facts.open_edges = f.counts->open_edges;
  }
  return facts;
}

NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius) {
  if (nsvcd__body_check(body, SIZE_MAX) || patch >= body->patches) return 0;
  const nsvcd__sphere sphere = nsvcd__sphere_of(nsvcd__body_patches(body), patch);
  nsvcd__f3_store(sphere.centre, centre);
  *radius = sphere.radius + nsvcd__whole_radius(body) - body->radius;
  return 1;
}

// -------------------------------------------------------------------------------------- body/write
// In: a surface, and its mesh. Out: the body of triangles that body/geometry reads.

#ifndef NSVCD_NO_ENCODER
// Writes the codes of patch i; NULL: only counts their bytes. Returns how many.
static size_t nsvcd__numbers_write(const nsvcd__surface *s, size_t i, unsigned char *to) {
  size_t size = 0;
  uint32_t last = 0;
  for (size_t n = s->patches[i].first_triangle; n < s->patches[i + 1].first_triangle; n++) {
    const uint32_t id = s->ids[n];
    const uint32_t kind = id >> NSVCD__KIND_SHIFT;
    uint32_t code = (id - last) & NSVCD__NUMBER;
    code = s->solids.is_mixed ? code << 2 | kind : code << 1 | (kind == NSVCD__CLOSED);
    for (int more = 1; more; code >>= 7) {
      more = code > 0x7f;
      if (to) to[size] = (unsigned char)(more ? code | 0x80 : code);
      size++;
    }
    last = id;
  }
  return size;
}

// What a body of triangles is written from.
typedef struct nsvcd__writer {
  nsvcd__surface *surface;
  const nsvcd_mesh *mesh;
  // (vertices of the mesh) their numbers in the body, from 1; 0: none yet
  uint32_t *numbers;
  // (triangles) 1: stored in pieces
  uint8_t *cut;
  nsvcd__counts counts;
  nsvcd__geometry to;
} nsvcd__writer;

static size_t nsvcd__mesh_corner(const nsvcd_mesh *mesh, size_t t, size_t k) {
  return mesh->indices ? mesh->indices[3 * t + k] : t;
}

// Fills in the writer: counts what the body of a complete surface will have. 0 without memory.
static int nsvcd__geometry_count(nsvcd__writer *w, nsvcd__arena *arena) {
  const nsvcd__surface *s = w->surface;
  const nsvcd_mesh *mesh = w->mesh;
  nsvcd__counts *counts = &w->counts;
  w->numbers = NSVCD__TAKE(arena, uint32_t, s->coarse ? 0 : mesh->vertex_count);
  w->cut = NSVCD__TAKE(arena, uint8_t, s->coarse ? 0 : mesh->triangle_count);
  if (arena->failed) return 0;
  memset(counts, 0, sizeof *counts);
  counts->listed = (uint32_t)s->listed;
  counts->vertices = (uint32_t)s->vertex_count;
  counts->components = (uint32_t)s->seed_count;
  const nsvcd__solids *solids = &s->solids;
  // points alone have no topology
  counts->solids = counts->components;
  if (solids->components > 0) counts->solids = (uint32_t)solids->components;
  counts->open_solids = (uint32_t)solids->open_components;
  counts->open_edges = (uint32_t)solids->open_edges;
  counts->is_mixed = (uint32_t)solids->is_mixed;
  if (solids->gap > 0) counts->gap = nsvcd__above(solids->gap);
  uint64_t bytes = 0;
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__patch_bounds *patch = &s->patches[i];
    const size_t stored = patch[1].first_vertex - patch->first_vertex;
    const size_t points = stored + patch[1].first_named - patch->first_named;
    const size_t triangles = patch[1].first_triangle - patch->first_triangle;
    const size_t first = 3 * (size_t)patch->first_triangle;
    bytes += (uint64_t)3 * triangles * nsvcd__corner_bytes(points);
    bytes += nsvcd__numbers_write(s, i, NULL);
    for (size_t n = first; n < first + 3 * triangles && !s->coarse; n++)
      if (s->corners[n] < stored) w->cut[s->ids[n / 3] & NSVCD__NUMBER] = 1;
  }
  for (size_t n = 0; n < s->named_count; n++) {
    counts->positions += !w->numbers[s->named[n]];
    w->numbers[s->named[n]] = 1;
  }
  counts->references = (uint32_t)s->named_count - counts->positions;
  for (size_t n = 0; n < 3 * mesh->triangle_count && !s->coarse; n++) {
    if (!w->cut[n / 3]) continue;
    const size_t v = nsvcd__mesh_corner(mesh, n / 3, n % 3);
    counts->positions += !w->numbers[v];
    w->numbers[v] = 1;
    counts->cut += n % 3 == 0;
  }
  if (!s->coarse) memset(w->numbers, 0, mesh->vertex_count * sizeof *w->numbers);
  // with more the body is refused as too large
  counts->entry_bytes = bytes < 0xffffffffu ? (uint32_t)bytes : 0xffffffffu;
  return 1;
}

// Gives a vertex the next number, and writes its position. Returns the number, from 0.
static uint32_t nsvcd__position_write(nsvcd__writer *w, size_t vertex, uint32_t *count) {
  const float *from = w->mesh->positions + 3 * vertex;
  memcpy(w->to.positions + 3 * (size_t)*count, from, 3 * sizeof *from);
  w->numbers[vertex] = ++*count;
  return *count - 1;
}

// Writes the own vertices and references of patch `to`. Turns the names of the surface's patch
// `from` into numbers of the body's patch.
static void nsvcd__named_write(nsvcd__writer *w, size_t from, size_t to) {
  nsvcd__surface *s = w->surface;
  const nsvcd__geometry *f = &w->to;
  uint32_t *first_own = f->first_own + to;
  uint32_t *first_reference = f->first_reference + to;
  const size_t wide = f->reference_bytes;
  const nsvcd__patch_bounds *patch = &s->patches[from];
  uint32_t *named = s->named + patch->first_named;
  const size_t count = patch[1].first_named - patch->first_named;
  uint32_t own = patch[1].first_vertex - patch->first_vertex;
  uint32_t other = own;
  first_own[1] = first_own[0];
  first_reference[1] = first_reference[0];
  for (size_t n = 0; n < count; n++) other += !w->numbers[named[n]];
  for (size_t n = 0; n < count; n++) {
    const uint32_t number = w->numbers[named[n]];
    if (!number) {
      (void)nsvcd__position_write(w, named[n], &first_own[1]);
      named[n] = own++;
      continue;
    }
    const uint32_t wanted = number - 1;
    const uint16_t narrow = (uint16_t)wanted;
    unsigned char *at = f->references + wide * first_reference[1]++;
    if (wide == 2) memcpy(at, &narrow, 2);
    if (wide == 4) memcpy(at, &wanted, 4);
    named[n] = other++;
  }
}

// Writes the triangles that are stored in pieces, after all patches.
static void nsvcd__cut_write(nsvcd__writer *w) {
  const nsvcd_mesh *mesh = w->mesh;
  uint32_t *cut = w->to.cut;
  uint32_t *corners = w->to.cut_corners;
  uint32_t count = w->to.first_own[w->to.body->patches];
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    if (!w->cut[t]) continue;
    *cut++ = (uint32_t)t;
    for (size_t k = 0; k < 3; k++) {
      const size_t v = nsvcd__mesh_corner(mesh, t, k);
      const uint32_t known = w->numbers[v];
      *corners++ = known ? known - 1 : nsvcd__position_write(w, v, &count);
    }
  }
}

// Writes patch `to` of a body, from patch `from` of its surface. One without surface is a point.
static void nsvcd__patch_write(nsvcd__writer *w, size_t from, size_t to) {
  const nsvcd__surface *s = w->surface;
  const nsvcd__geometry *f = &w->to;
  const size_t padded = f->body->padded;
  const nsvcd__patch_bounds *patch = &s->patches[from];
  nsvcd__sphere ball = patch->ball;
  if (patch->hull_count == 0) ball.radius = 0;
  nsvcd__sphere_store(ball, (float *)(f->body + 1), padded, to);
  nsvcd__slab_store(patch->slab, f->slabs, padded, to);
  f->steps[to] = patch->step;
  f->margins[to] = patch->margin;
  f->errors[to] = patch->error;
  f->hull_counts[to] = patch->hull_count;

  const uint32_t vertex = patch->first_vertex;
  const uint32_t vertices = patch[1].first_vertex - vertex;
  const size_t first = patch->first_triangle;
  const size_t end = patch[1].first_triangle;
  int16_t *integers = f->vertices + 3 * (size_t)f->first_vertex[to];
  memcpy(integers, s->vertices + 3 * (size_t)vertex, 6 * (size_t)vertices);
  nsvcd__named_write(w, from, to);
  const uint32_t *named = s->named + patch->first_named;
  const size_t points = vertices + patch[1].first_named - patch->first_named;
  const size_t bytes = nsvcd__corner_bytes(points);
  unsigned char *begin = f->entries + f->first_byte[to];
  unsigned char *at = begin;
  for (size_t n = 3 * first; n < 3 * end; n++) {
    const size_t i = s->corners[n];
    const uint16_t corner = (uint16_t)(i < vertices ? i : named[i - vertices]);
    if (bytes == 1) at[0] = (unsigned char)corner;
    if (bytes == 2) memcpy(at, &corner, 2);
    at += bytes;
  }
  at += nsvcd__numbers_write(s, from, at);
  f->first_vertex[to + 1] = f->first_vertex[to] + vertices;
  f->first_triangle[to + 1] = f->first_triangle[to] + (uint32_t)(end - first);
  f->first_byte[to + 1] = f->first_byte[to] + (uint32_t)(at - begin);
}

// Writes the seeds group by group (counting sort). order: of the patches.
static void nsvcd__seeds_write(const nsvcd__writer *w, const uint16_t *order) {
  const nsvcd__surface *s = w->surface;
  const nsvcd__geometry *f = &w->to;
  uint32_t *first = f->first_seed;
  // the numbers of patches in the body, for now in place of their first vertices
  uint32_t *numbers = f->first_vertex;
  const size_t patches = f->body->patches;
  const size_t groups = nsvcd__body_groups(f->body);
  for (size_t i = 0; i < patches; i++) numbers[order[i]] = (uint32_t)i;
  for (size_t n = 0; n < s->seed_count; n++)
    first[numbers[s->seed_patches[n]] / NSVCD__GROUP + 1]++;
  for (size_t g = 0; g < groups; g++) first[g + 1] += first[g];
  for (size_t n = s->seed_count; n-- > 0;) {
    const size_t to = --first[numbers[s->seed_patches[n]] / NSVCD__GROUP + 1];
    nsvcd__f3_store(s->seeds[n], f->seeds + 3 * to);
  }
  // now first[g + 1] is where group g begins
  memmove(first, first + 1, groups * sizeof *first);
  first[groups] = (uint32_t)s->seed_count;
  memset(numbers, 0, patches * sizeof *numbers);
}

// Builds a body of triangles of `size` bytes in `memory`, and uses up the writer. order: (N) of the
// patches. NUMBER if it is too large, EMPTY if it is too small.
static nsvcd_result nsvcd__geometry_build(nsvcd__writer *w, const uint16_t *order, int open,
                                          void *memory, size_t size) {
  const nsvcd__surface *s = w->surface;
  const nsvcd__counts *counts = &w->counts;
  nsvcd_body *b = nsvcd__body_begin(memory, size, s->count, open);
  b->triangles = (uint32_t)w->mesh->triangle_count;
  (void)nsvcd__geometry_layout(b, s->count, counts, &w->to);
  *w->to.counts = *counts;
  nsvcd__seeds_write(w, order);
  for (size_t i = 0; i < s->count; i++) nsvcd__patch_write(w, order[i], i);
  if (!s->coarse) nsvcd__cut_write(w);
  if (!nsvcd__in_range(nsvcd__body_r(b), b->patches, 4 * NSVCD_MAX_COORDINATE))
    return NSVCD_ERROR_NUMBER;
  nsvcd__geometry_finish(b, 0);
  return b->radius + counts->convex_radius < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER

// ------------------------------------------------------------------------------------- body/encode
// In: a mesh. Out: a body. Region by region the surface is split into patches, and these become
// latents and triangles; then all are written into one blob, neighbours side by side.

#ifndef NSVCD_NO_ENCODER
// A body in the making.
typedef struct nsvcd__draft {
  const nsvcd_mesh *mesh;
  // defaults filled in: `patches` is not 0, `latents` tells whether there will be any
  const nsvcd_encode_options *options;
  // of all arrays
  nsvcd__arena arena;
  size_t count;  // N
  // 1: patches are in order
  int in_runs;
  // bytes; 0: without
  size_t latents_size, geometry_size;
  // without latents only centres
  nsvcd__latents latents;
  nsvcd__surface surface;
  nsvcd__writer writer;
} nsvcd__draft;

static int nsvcd__is_cancelled(const nsvcd_encode_options *options, double done) {
  return options->progress && options->progress((float)done, options->user);
}

#ifndef NSVCD_NO_NETWORK
// Adds the latents of a region's patches.
static void nsvcd__add_latents(nsvcd__draft *d, nsvcd__sorted *sorted) {
  const nsvcd__region *region = sorted->pieces->region;
  const nsvcd__patches *patches = sorted->pieces->patches;
  const nsvcd__latents *out = &d->latents;
  for (size_t i = 0; i < patches->count; i++) {
    const size_t to = d->count + i;
    const float radius = patches->radii[i];
    const size_t first = patches->offsets[i];
    nsvcd__encoded patch;
    patch.samples = patches->samples + first;
    patch.normals = patches->normals + first;
    patch.count = patches->offsets[i + 1] - first;
    patch.centre = patches->centres[i];
    patch.inverse_radius = radius > 0 ? 1 / radius : 0;
    float latent[NSVCD__LATENT];
    nsvcd__encode_patch(&patch, latent);
    for (size_t k = 0; k < NSVCD__LATENT; k++)
      out->latents[NSVCD__LATENT * to + k] = (int8_t)lrintf(127 * latent[k]);
    // Cuts are rounded in the region's mesh, each coordinate by at most half a unit in the last
    // place: so far the surface may leave the balls.
    const double margin = 1.1e-7 * region->greatest;
    const double wider = ((double)radius + margin) * (1 + 1e-7);
    out->radii[to] = region->cut_count > 0 ? (float)wider : radius;
    out->areas[to] = patches->area_vectors[i];
    nsvcd__extremes_of(sorted, i, out->radii[to], out->extremes + 3 * NSVCD__EXTREMES * to);
  }
}
#endif

// Adds the patches of region n, at most `most`.
static nsvcd_result nsvcd__add_region(nsvcd__draft *d, nsvcd__regions *regions, size_t n,
                                      size_t most) {
  nsvcd__region region;
  nsvcd__patches patches;
  nsvcd__pieces pieces;
  nsvcd__sorted sorted;
  nsvcd__arena spare = nsvcd__arena_of(d->arena.allocator);
  nsvcd_result result = nsvcd__region_begin(regions, n, &spare, &region);
  if (result == NSVCD_ERROR_EMPTY) return NSVCD_OK;
  if (!result) result = nsvcd__patches_build(&region.mesh, most, &spare, &patches);
  if (!result && (!nsvcd__pieces_build(&region, &patches, &spare, &pieces) ||
                  !nsvcd__sorted_build(&pieces, &spare, &sorted)))
    result = NSVCD_ERROR_MEMORY;
  if (!result) {
    nsvcd__f3 *centres = d->latents.centres + d->count;
    memcpy(centres, patches.centres, patches.count * sizeof *centres);
#ifndef NSVCD_NO_NETWORK
    if (d->options->latents) nsvcd__add_latents(d, &sorted);
#endif
    if (NSVCD__PROOF && !d->options->no_triangles)
      result = nsvcd__surface_add(&sorted, &d->surface);
    d->count += patches.count;
  }
  if (!result) nsvcd__region_end(regions, &region);
  nsvcd__arena_free(&spare);
  return result;
}

// Drafts a mesh that has points or segments, in runs, block by block. There are no latents.
static nsvcd_result nsvcd__draft_runs(nsvcd__draft *d) {
  const nsvcd_mesh *mesh = d->mesh;
  const size_t triangles = mesh->triangle_count;
  const nsvcd_encode_options *o = d->options;
  const size_t runs = o->patches < triangles ? o->patches : triangles;
  nsvcd__arena spare = nsvcd__arena_of(d->arena.allocator);
  nsvcd__surface *s = &d->surface;
  nsvcd__curve curve;
  int ok = nsvcd__surface_begin(runs, mesh->vertex_count, o->coarse, &d->arena, s);
  ok = ok && nsvcd__curve_build(mesh, o->convex_radius, &spare, &curve);
  ok = ok && nsvcd__surface_room(s, mesh->vertex_count, mesh->vertex_count, triangles);
  if (ok) s->solids = curve.solids;
  nsvcd_result result = ok ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  for (size_t first = 0; !result && first < runs; first = s->count) {
    const int is_last = runs - first <= NSVCD__RUNS_AT_ONCE;
    const size_t last = is_last ? runs : first + NSVCD__RUNS_AT_ONCE;
    nsvcd__region block;
    nsvcd__patches patches;
    nsvcd__pieces pieces;
    nsvcd__arena few = nsvcd__arena_of(spare.allocator);
    ok = nsvcd__runs_build(&curve, first, last, runs, &few, &block, &patches, &pieces);
    nsvcd__sorted sorted;
    ok = ok && nsvcd__sorted_build(&pieces, &few, &sorted);
    result = ok ? nsvcd__surface_add(&sorted, s) : NSVCD_ERROR_MEMORY;
    nsvcd__arena_free(&few);
    const double done = (double)last / (double)runs;
    if (!result && nsvcd__is_cancelled(o, 0.9 * done)) result = NSVCD_ERROR_CANCELLED;
  }
  d->count = runs;
  nsvcd__arena_free(&spare);
  return result;
}

// Drafts a mesh region by region.
static nsvcd_result nsvcd__draft_regions(nsvcd__draft *d) {
  const nsvcd_encode_options *o = d->options;
  const size_t patches = o->patches;
  nsvcd__arena *arena = &d->arena;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  nsvcd__regions regions;
  if (!nsvcd__regions_build(d->mesh, patches, &spare, &regions)) {
    nsvcd__arena_free(&spare);
    return NSVCD_ERROR_MEMORY;
  }
  nsvcd__latents *latents = &d->latents;
  latents->centres = NSVCD__TAKE(arena, nsvcd__f3, patches);
#ifndef NSVCD_NO_NETWORK
  const size_t room = o->latents ? patches : 0;
  latents->radii = NSVCD__TAKE(arena, float, room);
  latents->areas = NSVCD__TAKE(arena, nsvcd__f3, room);
  latents->extremes = NSVCD__TAKE(arena, int8_t, 3 * NSVCD__EXTREMES * room);
  latents->latents = NSVCD__TAKE(arena, int8_t, NSVCD__LATENT * room);
#endif
  if (NSVCD__PROOF && !o->no_triangles)
    (void)nsvcd__surface_begin(patches, regions.component_count, o->coarse, arena,
                               &d->surface);
  d->surface.solids = regions.solids;
  const size_t count = regions.count;
  nsvcd_result result = arena->failed ? NSVCD_ERROR_MEMORY : NSVCD_OK;
  for (size_t n = 0; !result && n < count; n++) {
    const size_t most = patches * (n + 1) / count - patches * n / count;
    const double done = (double)(n + 1) / (double)(count + 2);
    const int stop = nsvcd__is_cancelled(o, done);
    result = stop ? NSVCD_ERROR_CANCELLED : nsvcd__add_region(d, &regions, n, most);
  }
  nsvcd__arena_free(&spare);
  return result;
}

// Makes everything but the blob. After success, free the draft's arena. MEMORY, CANCELLED,
// TOO_LARGE.
static nsvcd_result nsvcd__draft_build(const nsvcd_mesh *mesh, const nsvcd_encode_options *o,
                                       const nsvcd_allocator *alloc, nsvcd__draft *d) {
  memset(d, 0, sizeof *d);
  d->mesh = mesh;
  d->options = o;
  d->arena = nsvcd__arena_of(alloc);
  if (nsvcd__is_cancelled(o, 0)) return NSVCD_ERROR_CANCELLED;
  d->in_runs = NSVCD__PROOF && o->convex_radius > 0 && nsvcd__has_points(mesh);
  nsvcd_result result = d->in_runs ? nsvcd__draft_runs(d) : nsvcd__draft_regions(d);
#ifndef NSVCD_NO_NETWORK
  if (!result && o->latents) d->latents_size = nsvcd_body_size(d->count);
#endif
  if (NSVCD__PROOF && !result && !o->no_triangles) {
    nsvcd__writer *w = &d->writer;
    w->surface = &d->surface;
    w->mesh = mesh;
    if (!nsvcd__geometry_count(w, &d->arena)) result = NSVCD_ERROR_MEMORY;
    w->counts.convex_radius = o->convex_radius;
    d->geometry_size = nsvcd__geometry_layout(NULL, d->count, &w->counts, &w->to);
    if (!result && !d->geometry_size) result = NSVCD_ERROR_TOO_LARGE;
  }
  if (result) nsvcd__arena_free(&d->arena);
  return result;
}

// Orders the patches and writes the blob: the body of latents, then the body of triangles. MEMORY,
// NUMBER, EMPTY.
static nsvcd_result nsvcd__draft_write(nsvcd__draft *d, void *memory) {
  const size_t count = d->count;
  nsvcd__latents *latents = &d->latents;
  latents->count = count;
  latents->open = d->options->open;
  uint16_t *order = NSVCD__TAKE(&d->arena, uint16_t, 2 * count);
  if (!order) return NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < count; i++) order[i] = (uint16_t)i;
  if (!d->in_runs) nsvcd__body_order(latents->centres, order, order + count, count);
  latents->order = order;
  nsvcd_result result = NSVCD_OK;
#ifndef NSVCD_NO_NETWORK
  if (d->latents_size) result = nsvcd__body_build(latents, memory);
#endif
  void *to = (char *)memory + d->latents_size;
  if (NSVCD__PROOF && !result && d->geometry_size)
    result = nsvcd__geometry_build(&d->writer, order, latents->open, to, d->geometry_size);
  if (result || !d->latents_size || !d->geometry_size) return result;
  nsvcd_body *b = (nsvcd_body *)memory;
  b->triangles = (uint32_t)d->mesh->triangle_count;
  b->inner = (uint32_t)d->latents_size;
  b->size = (uint32_t)(d->latents_size + d->geometry_size);
  b->checksum = nsvcd__body_checksum(b);
  return NSVCD_OK;
}

// The default number of patches. area: of the mesh, square metres.
static size_t nsvcd__patches_for(const nsvcd_mesh *mesh, float patch_radius, double area,
                                 int triangles) {
  const double most = NSVCD_MAX_PATCHES;
  if (patch_radius > 0) {
    // N balls of radius r cover an area of about N r^2 / 0.45, as measured on real meshes for
    // N = 32 to 512.
    const double square = (double)patch_radius * (double)patch_radius;
    const double count = ceil(0.45 * area / square);
    return (size_t)fmin(fmax(count, 1), most);
  }
  if (!triangles) return NSVCD_DEFAULT_NETWORK_PATCHES;
  if (mesh->triangle_count <= NSVCD_LEAST_PATCHES) return NSVCD_LEAST_PATCHES;
  if (mesh->triangle_count <= NSVCD_VERY_FEW_TRIANGLES) return mesh->triangle_count;
  const int is_level = mesh->triangle_count > NSVCD_MANY_TRIANGLES;
  const size_t each = is_level ? NSVCD_LEVEL_TRIANGLES : NSVCD_PATCH_TRIANGLES;
  const size_t limit = is_level ? NSVCD_MAX_PATCHES : NSVCD_SMALL_PATCHES;
  const size_t count = mesh->triangle_count / each;
  if (count < NSVCD_DEFAULT_PATCHES) return NSVCD_DEFAULT_PATCHES;
  return count < limit ? count : limit;
}

// Checks options and mesh, and fills in the defaults.
static nsvcd_result nsvcd__encode_resolve(const nsvcd_mesh *mesh, nsvcd_encode_options *o) {
  if (!NSVCD__PROOF) o->no_triangles = 1;
  if (o->no_triangles) o->latents = 1;
#ifdef NSVCD_NO_NETWORK
  if (o->latents) return NSVCD_ERROR_LATENTS;
#endif
  if (!nsvcd__is_finite(o->patch_radius) || o->patch_radius < 0) return NSVCD_ERROR_PATCHES;
  if (!nsvcd__is_length(o->convex_radius)) return NSVCD_ERROR_RADIUS;
  if (o->convex_radius > 0 && o->latents) return NSVCD_ERROR_LATENTS;
  if (o->patches > NSVCD_MAX_PATCHES) return NSVCD_ERROR_PATCHES;
  const nsvcd_result checked = mesh->indices ? nsvcd__mesh_check(mesh) : NSVCD_OK;
  if (checked) return checked;
  if (o->patches == 0 && o->convex_radius > 0 && nsvcd__has_points(mesh))
    o->patches = nsvcd__runs_for(mesh);
  if (o->patches > 0 && o->convex_radius > 0) return NSVCD_OK;
  const double area = nsvcd__mesh_area(mesh);
  if (!(area > 0) && !(o->convex_radius > 0)) return NSVCD_ERROR_EMPTY;
  if (o->patches == 0)
    o->patches = nsvcd__patches_for(mesh, o->patch_radius, area, !o->no_triangles);
  return NSVCD_OK;
}

// nsvcd_encode of a mesh; or of a checked cloud: a mesh without indices, whose triangle t is point
// t.
static nsvcd_result nsvcd__encode_mesh(const nsvcd_mesh *mesh,
                                       const nsvcd_encode_options *options,
                                       const nsvcd_allocator *alloc, void *memory,
                                       size_t capacity, const nsvcd_body **body) {
  if (!body) return NSVCD_ERROR_ARGUMENT;
  if (memory && !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_encode_options o;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  nsvcd__draft draft;
  nsvcd_result result = nsvcd__encode_resolve(mesh, &o);
  if (!result) result = nsvcd__draft_build(mesh, &o, alloc, &draft);
  if (result) return result;

  const int fits = draft.geometry_size <= 0xffffffffu - draft.latents_size;
  const size_t size = draft.latents_size + draft.geometry_size;
  void *to = memory || !fits ? memory : nsvcd__alloc(alloc, size);
  if (!fits) {
    result = NSVCD_ERROR_TOO_LARGE;
  } else if (!to) {
    result = NSVCD_ERROR_MEMORY;
  } else if ((memory && capacity < size) || !nsvcd__is_aligned(to)) {
    result = NSVCD_ERROR_WORKSPACE;
  } else {
    result = nsvcd__draft_write(&draft, to);
  }
  if (!result) *body = (const nsvcd_body *)to;
  if (result && !memory) nsvcd__free(alloc, to);
  nsvcd__arena_free(&draft.arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *alloc, void *memory, size_t capacity,
                                   const nsvcd_body **body) {
  if (!mesh || !mesh->indices) return nsvcd__mesh_check(mesh);
  return nsvcd__encode_mesh(mesh, options, alloc, memory, capacity, body);
}

NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *alloc) {
  void *memory;
  if (nsvcd__body_check(body, SIZE_MAX)) return;
  // a cast would take away a const
  memcpy(&memory, &body, sizeof memory);
  nsvcd__free(alloc, memory);
}
#endif  // NSVCD_NO_ENCODER

// ------------------------------------------------------------------------------------- body/shapes
// In: the sizes of a shape. Out: its body: a skeleton of points, segments or a box, and a convex
// radius.

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_PROOF)
static nsvcd_result nsvcd__encode_rounded(const nsvcd_mesh *mesh, float convex_radius,
                                          const nsvcd_allocator *alloc,
                                          const nsvcd_body **body) {
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.convex_radius = convex_radius;
  return nsvcd__encode_mesh(mesh, &options, alloc, NULL, 0, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_sphere(float radius, const nsvcd_allocator *alloc,
                                          const nsvcd_body **body) {
  float centre[3] = {0, 0, 0};
  uint32_t point[3] = {0, 0, 0};
  const nsvcd_mesh mesh = {centre, point, 1, 1};
  if (!(radius > 0)) return NSVCD_ERROR_RADIUS;
  return nsvcd__encode_rounded(&mesh, radius, alloc, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_capsule(const float from[3], const float to[3],
                                           float radius, const nsvcd_allocator *alloc,
                                           const nsvcd_body **body) {
  float ends[6];
  uint32_t segment[3] = {0, 1, 1};
  const nsvcd_mesh mesh = {ends, segment, 2, 1};
  if (!from || !to) return NSVCD_ERROR_ARGUMENT;
  if (!(radius > 0)) return NSVCD_ERROR_RADIUS;
  memcpy(ends, from, 3 * sizeof *from);
  memcpy(ends + 3, to, 3 * sizeof *to);
  return nsvcd__encode_rounded(&mesh, radius, alloc, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_box(const float half[3], float convex_radius,
                                       const nsvcd_allocator *alloc, const nsvcd_body **body) {
  // bit k of a corner's number: it is on the positive side of axis k
  uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  float corners[24];
  const nsvcd_mesh mesh = {corners, faces, 8, 12};
  if (!half) return NSVCD_ERROR_ARGUMENT;
  if (!(convex_radius >= 0)) return NSVCD_ERROR_RADIUS;
  for (size_t k = 0; k < 3; k++) {
    if (!(half[k] > 0) || !(half[k] >= convex_radius)) return NSVCD_ERROR_RADIUS;
    for (size_t n = 0; n < 8; n++)
      corners[3 * n + k] = n >> k & 1 ? half[k] - convex_radius : convex_radius - half[k];
  }
  return nsvcd__encode_rounded(&mesh, convex_radius, alloc, body);
}

NSVCDDEF nsvcd_result nsvcd_encode_cloud(const float *points, size_t count, float radius,
                                         const nsvcd_allocator *alloc,
                                         const nsvcd_body **body) {
  nsvcd_mesh mesh = {NULL, NULL, count, count};
  if (!points) return NSVCD_ERROR_ARGUMENT;
  if (!(radius > 0)) return NSVCD_ERROR_RADIUS;
  if (count == 0) return NSVCD_ERROR_EMPTY;
  if (count > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  if (!nsvcd__in_range(points, 3 * count, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  // a cast would take away a const; nothing is written
  memcpy(&mesh.positions, &points, sizeof points);
  return nsvcd__encode_rounded(&mesh, radius, alloc, body);
}
#endif

// ======================================== motion: where bodies are, and the memory of their search

// ----------------------------------------------------------------------------------- motion/motion
// In: two movers: bodies, scales, pivots, and poses over t in [0,1]. Between poses the position of
// the pivot is linear, the rotation a slerp on the shorter arc. Out: the pose of one body,
// *moving*, in the frame of the other, *fixed*, at any t.
//
// Both may move; "fixed" says whose frame it is. That frame has the axes of the fixed body and
// its scale as the unit, so that its stored numbers need no change: a point x of the moving body is
// at scale R x + p. Positions are subtracted in the world first, so a scene far from the origin
// loses no precision. Poses exactly 180 degrees apart have two shortest arcs: rounding picks one.
//
// Time is counted in *ticks*, of which a motion has a whole number, and so has each body between
// two of its poses: the least common multiple. If poses have times of their own there are at least
// 2^31 ticks, and each time is rounded to the nearest. A *keyframe* is a tick at which either body
// reaches a pose. Between keyframes both motions are smooth.

// The poses of one body.
typedef struct nsvcd__track {
  const nsvcd_pose *poses;  // (count), the caller's
  const float *times;       // (count), the caller's; NULL: uniform, or a single pose
  size_t count;
  uint32_t ticks;  // from a pose to the next; of a single pose all; 0 if there are times
  uint32_t whole;  // ticks of the motion, if there are times
  float scale;
  const float *pivot;  // (3), the caller's; NULL: the origin, or a single pose
} nsvcd__track;

// From the body's origin to its pivot, in the body's axes, metres.
static nsvcd__d3 nsvcd__track_pivot(const nsvcd__track *track) {
  if (!track->pivot) return nsvcd__d3_of(0, 0, 0);
  return nsvcd__d3_scale(nsvcd__d3_load(track->pivot), (double)track->scale);
}

// The tick at which a track's pose k is.
static uint32_t nsvcd__tick_of(const nsvcd__track *track, uint32_t k) {
  if (!track->times) return k * track->ticks;
  return (uint32_t)((double)track->times[k] * (double)track->whole + 0.5);
}

// The last pose at or before a tick, but never the last of several: an arc follows it.
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
  uint32_t ticks;          // in all
  double begin, duration;  // t from begin on: 0 and 1; of one end alone 0 or 1, and 0
  int fixed_moves;
  // The moving body's scale over the fixed one's, as triangles are placed; rounded, as in all that
  // allows for roundings of floats; and its inverse.
  double ratio;
  float scale, per_scale;
  float unit;                // the fixed body's scale, in metres
  nsvcd__f3 fixed_position;  // of the fixed body at t = 0, metres
  // from world axes to the fixed body's at t = 0
  nsvcd__mat3 to_fixed;
  nsvcd__quat to_fixed_quat;
  // added to the moving body's positions, in the fixed body's frame
  nsvcd__f3 push_out;
  // Of an interval: its first tick, and how many arcs a segment has. 0, 0: the whole motion.
  uint32_t from, arcs;
  int is_fine;  // its segments turn by less than usual
} nsvcd__motion;

static nsvcd_result nsvcd__mover_check(const nsvcd_mover *mover) {
  const nsvcd_result result = nsvcd__body_check(mover->body, SIZE_MAX);
  if (result) return result;
  const float scale = mover->scale;
  if (!nsvcd__is_finite(scale) || scale < 0) return NSVCD_ERROR_SCALE;
  if (scale > 0) {
    const float radius = scale * nsvcd__whole_radius(mover->body);
    const float extent = scale * mover->body->extent;
    if (scale < NSVCD_MIN_SCALE || scale > NSVCD_MAX_SCALE) return NSVCD_ERROR_SCALE;
    if (radius < NSVCD_MIN_RADIUS || extent > 2 * NSVCD_MAX_COORDINATE)
      return NSVCD_ERROR_SCALE;
  }
  return nsvcd__track_check(mover);
}

static nsvcd__track nsvcd__track_of(const nsvcd_mover *mover) {
  const size_t count = nsvcd__pose_count(mover);
  const nsvcd_pose *poses = mover->poses ? mover->poses : &nsvcd__at_origin;
  const float *c = mover->pivot;
  const int has_pivot = fabsf(c[0]) + fabsf(c[1]) + fabsf(c[2]) > 0;
  nsvcd__track track = {poses, NULL, count, 0, 0, 1, NULL};
  track.scale = nsvcd__scale_of(mover);
  if (count > 1) track.times = mover->times;
  if (count > 1 && has_pivot) track.pivot = c;
  return track;
}

static uint32_t nsvcd__arc_count(const nsvcd__track *track) {
  return track->count > 1 ? (uint32_t)(track->count - 1) : 1;
}

// Sets the ticks as if all poses were uniform: `parts` times as many as the keyframes need. At most
// 65,535 * 65,534, which fits 32 bits: parts is above 1 only where there are few keyframes.
static void nsvcd__motion_set_ticks(nsvcd__motion *m, uint32_t parts) {
  const uint32_t a = nsvcd__arc_count(&m->moving);
  const uint32_t b = nsvcd__arc_count(&m->fixed);
  uint32_t divisor = a;
  for (uint32_t rest = b; rest;) {
    const uint32_t next = divisor % rest;
    divisor = rest;
    rest = next;
  }
  m->ticks = a / divisor * b * parts;
  m->moving.ticks = m->ticks / a;
  m->fixed.ticks = m->ticks / b;
}

#ifndef NSVCD_NO_PROOF
// Makes ticks finer if there are few. Returns how many a tick becomes.
static double nsvcd__motion_refine(nsvcd__motion *m) {
  uint32_t finer = 1;
  for (; m->ticks < 0x40000000u; m->ticks *= 2) finer *= 2;
  m->moving.ticks *= finer;
  m->fixed.ticks *= finer;
  return (double)finer;
}
#endif

// Sets the ticks if poses have times: the arcs of a uniform body times a power of two, so that its
// poses, and times of few bits, fall on ticks.
static void nsvcd__motion_set_times(nsvcd__motion *m) {
  nsvcd__track *a = &m->moving;
  nsvcd__track *b = &m->fixed;
  if (!a->times && !b->times) return;
  const uint32_t arcs_a = nsvcd__arc_count(a);
  const uint32_t arcs_b = nsvcd__arc_count(b);
  m->ticks = (a->times ? 1 : arcs_a) * (b->times ? 1 : arcs_b);
  while (m->ticks < 0x80000000u) m->ticks *= 2;
  a->whole = b->whole = m->ticks;
  a->ticks = a->times ? 0 : m->ticks / arcs_a;
  b->ticks = b->times ? 0 : m->ticks / arcs_b;
}

// Converts begin (S + 1) from uniform ticks to those of a motion whose poses have times. Segments
// are chosen as if the poses were uniform, for what counts is how far bodies move in one.
static void nsvcd__motion_retime(nsvcd__motion *m, uint32_t *begin, size_t segments) {
  const nsvcd__track *track = m->moving.times ? &m->moving : &m->fixed;
  if (!track->times) return;
  const uint32_t each = track->ticks;
  nsvcd__motion_set_times(m);
  for (size_t s = 0; s < segments; s++) {
    const uint32_t k = begin[s] / each;
    const uint32_t from = nsvcd__tick_of(track, k);
    const uint64_t length = nsvcd__tick_of(track, k + 1) - from;
    begin[s] = from + (uint32_t)(length * (begin[s] - k * each) / each);
  }
  begin[segments] = m->ticks;
}

// The box of the positions of a track's pivot.
static nsvcd__box nsvcd__track_box(const nsvcd__track *track) {
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  nsvcd__box box;
  box.low = box.high = nsvcd__f3_round(nsvcd__pivot_of(track->poses, pivot));
  for (size_t n = 1; n < track->count; n++) {
    const nsvcd__f3 position = nsvcd__f3_round(nsvcd__pivot_of(&track->poses[n], pivot));
    box.low = nsvcd__f3_min(box.low, position);
    box.high = nsvcd__f3_max(box.high, position);
  }
  return box;
}

// A lower bound of the distance between the pivots of bodies on two tracks, in units: they never
// leave the boxes of their positions.
static float nsvcd__tracks_gap(const nsvcd__track *moving, const nsvcd__track *fixed,
                               float unit) {
  const nsvcd__box a = nsvcd__track_box(moving);
  const nsvcd__box b = nsvcd__track_box(fixed);
  const nsvcd__f3 above = nsvcd__f3_sub(a.low, b.high);
  const nsvcd__f3 below = nsvcd__f3_sub(b.low, a.high);
  const nsvcd__f3 none = nsvcd__f3_of(0, 0, 0);
  const nsvcd__f3 gap = nsvcd__f3_max(nsvcd__f3_max(above, below), none);
  return 0.99999f * nsvcd__f3_norm(gap) / unit;
}

// How far a body's pivot is from its origin, in units.
static float nsvcd__pivot_arm(const nsvcd__motion *m, const nsvcd__track *track) {
  if (!track->pivot) return 0;
  return nsvcd__above(nsvcd__d3_norm(nsvcd__track_pivot(track)) / (double)m->unit);
}
static float nsvcd__pivot_arms(const nsvcd__motion *m) {
  return nsvcd__pivot_arm(m, &m->moving) + nsvcd__pivot_arm(m, &m->fixed);
}

static float nsvcd__motion_gap(const nsvcd__motion *m) {
  return nsvcd__tracks_gap(&m->moving, &m->fixed, m->unit);
}

// Sets all that follows from the tracks.
static void nsvcd__motion_set_tracks(nsvcd__motion *m, nsvcd__track moving,
                                     nsvcd__track fixed) {
  if (moving.count == 1) moving.pivot = NULL;
  if (fixed.count == 1) fixed.pivot = NULL;
  m->moving = moving;
  m->fixed = fixed;
  m->fixed_moves = fixed.count > 1;
  nsvcd__motion_set_ticks(m, 1);
  nsvcd__motion_set_times(m);
  m->from = m->arcs = 0;
  m->is_fine = 0;

  const nsvcd_pose *first = fixed.poses;
  const nsvcd__quat q = nsvcd__quat_unit(nsvcd__quat_load(first->rotation));
  m->to_fixed = nsvcd__mat3_transpose(nsvcd__mat3_of(q));
  m->to_fixed_quat = nsvcd__quat_inverse(q);
  m->fixed_position = nsvcd__f3_load(first->position);
}

// The motion of valid movers, whose poses it points to.
static void nsvcd__motion_init(const nsvcd_mover *moving, const nsvcd_mover *fixed,
                               nsvcd__motion *m) {
  m->unit = nsvcd__scale_of(fixed);
  m->ratio = (double)nsvcd__scale_of(moving) / (double)m->unit;
  m->scale = (float)m->ratio;
  m->per_scale = 1 / m->scale;
  m->push_out = nsvcd__f3_of(0, 0, 0);
  m->begin = 0;
  m->duration = 1;
  nsvcd__motion_set_tracks(m, nsvcd__track_of(moving), nsvcd__track_of(fixed));
}

// A body's rotation in the world, unit to 1e-4, and the position of its pivot, metres. In double,
// because on a long path past the other body rounding its ends would be large beside the clearance.
typedef struct nsvcd__world_pose {
  nsvcd__quat rotation;
  nsvcd__d3 position;
} nsvcd__world_pose;

static nsvcd__world_pose nsvcd__world_pose_of(const nsvcd_pose *pose, nsvcd__d3 pivot) {
  const nsvcd__world_pose out = {nsvcd__quat_load(pose->rotation),
                                 nsvcd__pivot_of(pose, pivot)};
  return out;
}

// The pose at a fraction between two.
static nsvcd__world_pose nsvcd__world_pose_between(const nsvcd_pose *a, const nsvcd_pose *b,
                                                   nsvcd__d3 pivot, double fraction) {
  const nsvcd__world_pose from = nsvcd__world_pose_of(a, pivot);
  const nsvcd__world_pose to = nsvcd__world_pose_of(b, pivot);
  nsvcd__world_pose out;
  out.rotation = nsvcd__quat_slerp(from.rotation, to.rotation, (float)fraction);
  out.position = nsvcd__d3_mix(from.position, to.position, fraction);
  return out;
}

// A track's pose at a tick.
static nsvcd__world_pose nsvcd__track_pose(const nsvcd__track *track, uint32_t tick) {
  const uint32_t k = nsvcd__pose_before(track, tick);
  const nsvcd_pose *a = &track->poses[k];
  const uint32_t from = nsvcd__tick_of(track, k);
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  if (tick == from || track->count == 1) return nsvcd__world_pose_of(a, pivot);
  const uint32_t to = nsvcd__tick_of(track, k + 1);
  if (tick == to) return nsvcd__world_pose_of(a + 1, pivot);
  const double fraction = (double)(tick - from) / (double)(to - from);
  return nsvcd__world_pose_between(a, a + 1, pivot, fraction);
}

// The tick of a track's next pose after a tick that is not the last.
static uint32_t nsvcd__next_pose(const nsvcd__track *track, uint32_t tick) {
  return nsvcd__tick_of(track, nsvcd__pose_before(track, tick) + 1);
}

// The keyframe after a tick.
static uint32_t nsvcd__next_keyframe(const nsvcd__motion *m, uint32_t tick) {
  if (m->moving.ticks == 1 || m->fixed.ticks == 1) return tick + 1;
  const uint32_t after_a = nsvcd__next_pose(&m->moving, tick);
  const uint32_t after_b = nsvcd__next_pose(&m->fixed, tick);
  return after_a < after_b ? after_a : after_b;
}

#ifndef NSVCD_NO_NETWORK
// The pose of a moving track before time t in [0,1], and the fraction of the arc after it. Uniform
// tracks are not rounded to ticks: derivatives by t need all that floats resolve.
static size_t nsvcd__pose_at(const nsvcd__track *track, float t, float *fraction) {
  if (track->times) {
    const double tick = (double)t * (double)track->whole;
    const uint32_t k = nsvcd__pose_before(track, (uint32_t)tick);
    const float from = track->times[k];
    *fraction = (t - from) / (track->times[k + 1] - from);
    return k;
  }
  const size_t last = track->count - 2;
  const float at = t * (float)(last + 1);
  const size_t k = (size_t)at < last ? (size_t)at : last;
  *fraction = at - (float)k;
  return k;
}
#endif

// -------------------------------------------------------------------------------- motion/workspace
// In: how large a query's bodies and motions are. Out: the memory of its search, laid out: the
// segments of a motion, spheres on chords in them, and tiles of groups.

// ---- lanes

// The vector in lane l alone.
static inline nsvcd__f3 nsvcd__lane_of(nsvcd__row *p, size_t l) {
  return nsvcd__f3_get(p[0] + l, NSVCD__LANES);
}
static inline void nsvcd__lane_set(nsvcd__f3 a, nsvcd__row *p, size_t l) {
  nsvcd__f3_put(a, p[0] + l, NSVCD__LANES);
}
// The matrix in lane l of p (9, LANES), row-major.
static inline nsvcd__mat3 nsvcd__mat3_lane(nsvcd__row *p, size_t l) {
  const nsvcd__mat3 out = {nsvcd__lane_of(p, l), nsvcd__lane_of(p + 3, l),
                           nsvcd__lane_of(p + 6, l)};
  return out;
}

// ---- segments, and what is searched

// of a motion that turns by no more than NSVCD__SEGMENT_TURN in each
#define NSVCD__SEGMENTS 16
// at most: enough for 1280 degrees; what turns more is cut into intervals (motion/choice)
#define NSVCD__MAX_SEGMENTS 64

// Times the lengths that enter a difference of positions: about 15 float operations of 6e-8 each,
// doubled.
#define NSVCD__ROUNDING 2e-6f

// 16 segments: the pose at the start, its change until the end, and bounds of the deviation.
typedef struct nsvcd__segments {
  nsvcd__row rotation[9], position[3];
  nsvcd__row turned[9], moved[3];
  nsvcd__row margin, bend;
  // For the proof, along directions: see nsvcd__deviation_of.
  nsvcd__row rounding, axis[3], heading[3];
  nsvcd__row bend_along_axis;
  nsvcd__row origin_bend, origin_along_axis;
  nsvcd__row origin_off_heading;
} nsvcd__segments;

#define NSVCD__ENDS (NSVCD__LANES + 1)  // of 16 segments, one after the other

// Poses of both bodies at the ends of segments, or at other ticks, in the world.
typedef struct nsvcd__keyframes {
  float moving[4 * NSVCD__ENDS];  // (4, ENDS) quaternions, as the next two
  float fixed[4 * NSVCD__ENDS];
  float seen[4 * NSVCD__ENDS];    // the moving body's, in the fixed body's frame
  float offset[3 * NSVCD__ENDS];  // (3, ENDS) see nsvcd__v_poses
} nsvcd__keyframes;

// The greatest values so far of 16 segments, while their keyframes are visited.
typedef struct nsvcd__bends {
  nsvcd__row turn;  // the sum of the arcs' angles
  // arcs off their chords: per metre from the moving origin, along the axis too, and that origin
  nsvcd__row arc_bend, arc_along_axis, arc_origin;
  // keyframes off the segment's chord, squared: the rotation and the position, and both along the
  // axis; the position across the heading
  nsvcd__row off, origin_off, along_axis;
  nsvcd__row origin_along_axis, origin_off_heading;
} nsvcd__bends;

typedef struct nsvcd__cut {
  nsvcd__keyframes here, last, end;  // read now, the ones before, and at the segments' ends
  nsvcd__bends most;
} nsvcd__cut;

// 16 spheres on chords start + tau travel; their radii plus deviation, and -1 / |travel|^2.
typedef struct nsvcd__chords {
  nsvcd__row start[3], travel[3];
  nsvcd__row inverse, radius;
} nsvcd__chords;

typedef struct nsvcd__boxes {
  nsvcd__row low[3], high[3];
} nsvcd__boxes;

// Groups that are searched together. Slots without a group have the radius NSVCD__NOWHERE.
typedef struct nsvcd__tile {
  size_t count;
  uint16_t groups[NSVCD__TILE_SLOTS];
  nsvcd__spheres spheres;  // the body's own if it has a single tile, else collected
  float *collected;        // (4, NSVCD__TILE_SLOTS), or NULL
} nsvcd__tile;

#ifndef NSVCD_NO_NETWORK
// The ranges of 16 patches along a plane's normal.
typedef struct nsvcd__ranges {
  nsvcd__row low, high;
} nsvcd__ranges;

#define NSVCD__PLANES 2  // that are remembered

// Planes that separated others, and the ranges of two groups along them: of the moving one in one
// segment.
typedef struct nsvcd__plane_cache {
  nsvcd__f3 planes[NSVCD__PLANES];  // normals: the last of those found
  uint32_t found, best;             // how many; which of them separated last
  float inflate;                    // patches, by so much of their radii
  int balls_only;                   // no planes are tried
  nsvcd__ranges moving[NSVCD__PLANES], resting[NSVCD__PLANES];
  uint32_t moving_known, resting_known;  // bits of planes whose ranges are filled in
  float deviation;                       // of the moving group's points in the segment
} nsvcd__plane_cache;

// A contact interval: the balls of patches `moving` and `fixed` overlap from t_enter to t_exit,
// with the deviation added.
typedef struct nsvcd__candidate {
  uint16_t moving, fixed;
  float t_enter, t_exit;
  float t_least;  // when they are nearest
  float depth;    // rank, 1 - least distance / (r1 + r2): the deepest go on to the network
  // what the network says: a logit, or NSVCD__NO_SCORE; and a distance, in tenths of r1 + r2
  float score, apart;
} nsvcd__candidate;

// The candidates kept so far: a heap with the shallowest at its root.
typedef struct nsvcd__candidates {
  nsvcd__candidate *items;  // (limit), the caller's
  size_t limit, count;
  size_t total;  // intervals found, kept or not
} nsvcd__candidates;
#endif

// What a query needs memory for.
typedef struct nsvcd__needs {
  size_t moving_groups, fixed_groups;  // of a tile
  int large;                           // a body has more than these
  size_t segments;                     // 16, 32, 48 or 64
  size_t candidates;                   // of the network
  int proof;
} nsvcd__needs;

// The broad phase of a query: `q` in these rooms.
typedef struct nsvcd__search {
  const nsvcd_body *moving, *fixed;
  // the segments, S of them, and how many there is memory for
  size_t segments, most_segments;
  float scale;              // of the moving body
  uint32_t *begin;          // (S + 1) ticks at which they begin, and the last one ends
  float *time;              // (S + 1) the same as times
  float *turn;              // (S + 1) angle turned from t = 0 until then, radians
  nsvcd__segments *blocks;  // (S / 16 rounded up)
  nsvcd__chords *group;     // (S / 16 rounded up) a moving group's
  nsvcd__chords *members;   // (S) its 16 members', per segment
  nsvcd__cut *cut;          // in the same memory: segments are cut before any search
  uint64_t near_segments;   // in which the bodies' spheres meet
  // of large bodies, through the groups that come near
  nsvcd__traversal moving_traversal, fixed_traversal;
  nsvcd__box near_box;  // about the path of the moving tile
  // the groups that are searched now; what follows are indices into these
  nsvcd__tile moving_tile, fixed_tile;
  // (moving groups, fixed groups) segments in which they meet: see nsvcd__nearby
  uint64_t *nearby;
  size_t nearby_stride;
  uint64_t wanted;  // segments to search: some of them where contacts are sought in order
  // moving groups that are near any, in the order of the search; how many, and the current one
  uint16_t order[NSVCD__TILE_SLOTS];
  size_t steps, step;
  uint32_t waiting;  // fixed groups that it has yet to be searched against
  size_t at;         // which of them is next
  uint64_t ready;    // segments for which members[] is filled
  float extent;      // of these members, from the body's origin
#ifndef NSVCD_NO_NETWORK
  nsvcd__plane_cache *cache;
  uint16_t *met;  // (GROUP, S) lanes of a group that meet each of another
  int balls_met;  // 0: no patches' balls meet, which proves free
#endif
} nsvcd__search;

// Arrays of 16 lanes begin on a cache line if there are vectors, for vectors that cross lines are
// slower. That skips so many bytes at most, all of which are counted where base is NULL.
#define NSVCD__PASSED_OVER (NSVCD__SLICE > 1 ? 64 - NSVCD_ALIGNMENT : 0)

// Lays a search out in base, or, where that is NULL, only counts.
static void nsvcd__search_layout(const nsvcd__needs *needs, char *base, uint64_t *used,
                                 nsvcd__search *q) {
  const size_t s = needs->segments;
  const size_t blocks = s / NSVCD__LANES;
  const size_t members = s * sizeof(nsvcd__chords);
  const size_t shared = members > sizeof(nsvcd__cut) ? members : sizeof(nsvcd__cut);
  const size_t collected = needs->large ? 4 * NSVCD__TILE_SLOTS : 0;
  const size_t pairs = needs->moving_groups * needs->fixed_groups;
  q->most_segments = s;
  q->begin = NSVCD__TAKE_ROWS(uint32_t, s + 1, base, used);
  q->time = NSVCD__TAKE_ROWS(float, s + 1, base, used);
  q->turn = NSVCD__TAKE_ROWS(float, s + 1, base, used);
  if (NSVCD__PASSED_OVER > 0)
    *used += base ? (0 - (uintptr_t)(base + *used)) & 63 : NSVCD__PASSED_OVER;
  q->blocks = NSVCD__TAKE_ROWS(nsvcd__segments, blocks, base, used);
  q->group = NSVCD__TAKE_ROWS(nsvcd__chords, blocks, base, used);
  q->members = (nsvcd__chords *)nsvcd__take(base, used, 1, shared);
  q->cut = (nsvcd__cut *)(void *)q->members;
  q->nearby_stride = needs->fixed_groups;
  q->nearby = NSVCD__TAKE_ROWS(uint64_t, pairs, base, used);
  q->moving_tile.collected = NSVCD__TAKE_ROWS(float, collected, base, used);
  q->fixed_tile.collected = NSVCD__TAKE_ROWS(float, collected, base, used);
}

// Scratch chords, and boxes: members[] before a group is posed.
static nsvcd__chords *nsvcd__spare_chords(const nsvcd__search *q) {
  return &q->members[0];
}
static nsvcd__boxes *nsvcd__spare_boxes(const nsvcd__search *q) {
  return (nsvcd__boxes *)(void *)&q->members[1];
}

// The segments in which group g of the moving tile meets each one of the fixed tile.
static uint64_t *nsvcd__nearby(const nsvcd__search *q, size_t g) {
  return q->nearby + g * q->nearby_stride;
}

static int nsvcd__is_large(const nsvcd_body *body) {
  return nsvcd__body_groups(body) > NSVCD__TILE;
}
static int nsvcd__is_tiled(const nsvcd_body *a, const nsvcd_body *b) {
  return nsvcd__is_large(a) || nsvcd__is_large(b);
}

// ----------------------------------------------------------------------------------- motion/choice
// In: a motion. Out: its segments: how many, when they begin, and their poses and deviations.
//
// A motion that is too long for one search is cut into *intervals*, each of which is searched with
// segments of its own: else a segment would hold hundreds of poses, or turn by hundreds of degrees,
// and separate nothing. An interval begins at a keyframe. It has as many arcs as there is room for:
// one in each segment, or one in several where it turns a lot. A *try* is larger: several arcs in
// each segment, and a small budget tells whether all of it is easy.

#define NSVCD__SEGMENT_TURN 0.349f  // radians, 20 degrees
#define NSVCD__FINE_TURN 0.131f     // 7.5 degrees: shorter segments gain nothing

// Upper bounds of the sum of a track's arcs of rotation, radians, and of the longest: as in
// nsvcd__v_arc.
static void nsvcd__measure_turn(const nsvcd__track *track, float *turn, float *widest) {
  *turn = *widest = 0;
  for (size_t n = 1; n < track->count; n++) {
    const nsvcd__quat a = nsvcd__quat_load(track->poses[n - 1].rotation);
    const nsvcd__quat b = nsvcd__quat_load(track->poses[n].rotation);
    const float sign = nsvcd__quat_dot(a, b) < 0 ? 1.0f : -1.0f;
    const nsvcd__quat chord = nsvcd__quat_fma(sign, b, a);
    const float x = 0.50025f * sqrtf(nsvcd__quat_dot(chord, chord));
    const float arc = x * (4 + 2.2832f * x * x);
    *turn += arc;
    *widest = arc > *widest ? arc : *widest;
  }
}

// How many segments. They begin at ticks; if there are too few of these, each is cut into `parts`,
// else 1.
static size_t nsvcd__segment_count(const nsvcd__motion *m, size_t greatest, uint32_t *parts) {
  const size_t ticks = m->ticks;
  float turn, widest, fixed_turn, fixed_widest;
  *parts = 1;
  if (m->moving.count == 1 && !m->fixed_moves) return 1;
  nsvcd__measure_turn(&m->moving, &turn, &widest);
  nsvcd__measure_turn(&m->fixed, &fixed_turn, &fixed_widest);
  turn = turn + fixed_turn < 1e3f ? turn + fixed_turn : 1e3f;
  const size_t coarse = (size_t)ceilf(turn / NSVCD__SEGMENT_TURN);
  const size_t fine = (size_t)ceilf(turn / NSVCD__FINE_TURN);
  size_t wanted = fine < NSVCD__SEGMENTS ? fine : NSVCD__SEGMENTS;
  if (wanted < coarse) wanted = coarse < greatest ? coarse : greatest;
  if (wanted < 1) wanted = 1;
  if (ticks > wanted) {
    const size_t enough = wanted < NSVCD__SEGMENTS ? NSVCD__SEGMENTS : wanted;
    return ticks < enough ? ticks : enough;
  }
  const float of_tick = widest / (float)m->moving.ticks + fixed_widest / (float)m->fixed.ticks;
  const size_t least = (size_t)ceilf(of_tick / NSVCD__SEGMENT_TURN);
  const size_t most = greatest / ticks;
  size_t each = wanted / ticks > least ? wanted / ticks : least;
  each = each < most ? each : most;
  *parts = (uint32_t)(each > 1 ? each : 1);
  return ticks * *parts;
}

// The segments of a whole motion: equally many ticks in each, to one.
static void nsvcd__choose_in_all(nsvcd__motion *m, nsvcd__search *q) {
  uint32_t parts;
  nsvcd__motion_set_ticks(m, 1);
  q->segments = nsvcd__segment_count(m, q->most_segments, &parts);
  nsvcd__motion_set_ticks(m, parts);
  const uint32_t segments = (uint32_t)q->segments;
  const uint32_t each = m->ticks / segments;
  const uint32_t over = m->ticks % segments;
  for (uint32_t s = 0; s <= segments; s++) q->begin[s] = each * s + over * s / segments;
  nsvcd__motion_retime(m, q->begin, segments);
}

// Sets the ticks of a motion that is cut into intervals: the same for all of them, and so many that
// an arc can be cut.
static void nsvcd__motion_set_fine_ticks(nsvcd__motion *m) {
  uint32_t parts = NSVCD__MAX_SEGMENTS;
  nsvcd__motion_set_ticks(m, 1);
  while (m->ticks > 0xffffffffu / parts) parts /= 2;
  nsvcd__motion_set_ticks(m, parts);
  nsvcd__motion_set_times(m);
}

// How far a track turns between ticks of the same arc: about, radians.
static float nsvcd__track_turn(const nsvcd__track *track, uint32_t from, uint32_t to) {
  if (track->count == 1) return 0;
  const uint32_t k = nsvcd__pose_before(track, from);
  const nsvcd__quat a = nsvcd__quat_load(track->poses[k].rotation);
  const nsvcd__quat b = nsvcd__quat_load(track->poses[k + 1].rotation);
  const float cosine = fabsf(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w);
  const float chord = sqrtf(2 * (cosine < 1 ? 1 - cosine : 0));
  const uint32_t length = nsvcd__tick_of(track, k + 1) - nsvcd__tick_of(track, k);
  return (2 + 0.1f * chord * chord) * chord * (float)(to - from) / (float)length;
}

// The segments of an interval.
static void nsvcd__choose_in_interval(nsvcd__motion *m, nsvcd__search *q) {
  const size_t most = q->most_segments;
  const int is_try = m->arcs > 1;
  const float step = m->is_fine ? NSVCD__FINE_TURN : NSVCD__SEGMENT_TURN;
  size_t segments = 0;
  nsvcd__motion_set_fine_ticks(m);
  q->begin[0] = m->from;
  while (segments < most && q->begin[segments] < m->ticks) {
    const uint32_t from = q->begin[segments];
    uint32_t to = from;
    for (uint32_t n = 0; n < m->arcs && to < m->ticks; n++) to = nsvcd__next_keyframe(m, to);
    const float turn =
        nsvcd__track_turn(&m->moving, from, to) + nsvcd__track_turn(&m->fixed, from, to);
    const float steps = ceilf(turn / step - 0.1f);
    const size_t turns = is_try || !(steps > 1) ? 1 : (size_t)steps;
    if (segments > 0 && segments + turns > most) break;
    const uint32_t parts = (uint32_t)(turns < most ? turns : most);
    const uint64_t length = to - from;
    for (uint32_t n = 1; n <= parts; n++)
      q->begin[++segments] = from + (uint32_t)(length * n / parts);
  }
  q->segments = segments;
}

// Chooses how many segments there are, and when they begin.
static void nsvcd__choose_segments(nsvcd__motion *m, nsvcd__search *q) {
  if (m->arcs > 0)
    nsvcd__choose_in_interval(m, q);
  else
    nsvcd__choose_in_all(m, q);
  q->scale = m->scale;
  const double per_tick = 1 / (double)m->ticks;
  for (size_t s = 0; s <= q->segments; s++)
    q->time[s] = (float)((double)q->begin[s] * per_tick);
}

// ---- intervals

static void nsvcd__choose_all(nsvcd__motion *m, nsvcd__search *q) {
  m->from = m->arcs = 0;
  m->is_fine = 0;
  nsvcd__choose_segments(m, q);
}

#ifndef NSVCD_NO_PROOF
// The tick of a position counted in segments: 1.5 is in the middle of the second.
static double nsvcd__tick_in_segments(const uint32_t *begin, double at) {
  const size_t s = (size_t)at;
  const double start = (double)begin[s];
  const double fraction = at - (double)s;
  return fraction > 0 ? start + fraction * ((double)begin[s + 1] - start) : start;
}

// Leaves the part of the segments between two positions, in ticks so many times finer.
static void nsvcd__narrow_segments(nsvcd__search *q, double from, double to, double finer) {
  uint32_t *begin = q->begin;
  const double start = nsvcd__tick_in_segments(begin, from);
  const double end = nsvcd__tick_in_segments(begin, to);
  const size_t first = (size_t)from;
  const size_t last = (size_t)to;
  q->segments = last - first + (to > (double)last);
  for (size_t s = 1; s < q->segments; s++)
    begin[s] = (uint32_t)(finer * (double)begin[first + s]);
  begin[0] = (uint32_t)(finer * start);
  begin[q->segments] = (uint32_t)(finer * end);
}

// An upper bound of the keyframes after a tick.
static size_t nsvcd__keyframes_after(const nsvcd__motion *m, uint32_t tick) {
  const size_t moving = m->moving.count - 1 - nsvcd__pose_before(&m->moving, tick);
  const size_t fixed = m->fixed.count - 1 - nsvcd__pose_before(&m->fixed, tick);
  return moving + fixed;
}

// Chooses the segments of the interval that begins at a tick, with so many arcs in each, or fewer
// at the end of the motion.
static void nsvcd__choose_interval(nsvcd__motion *m, nsvcd__search *q, uint32_t from,
                                   uint32_t arcs) {
  const size_t most = q->most_segments;
  const size_t left = (nsvcd__keyframes_after(m, from) + most - 1) / most;
  m->from = from;
  m->arcs = arcs < left ? arcs : (uint32_t)left;
  nsvcd__choose_segments(m, q);
}

// Is a motion too long for one search? If not, chooses its segments.
static int nsvcd__is_long(nsvcd__motion *m, nsvcd__search *q) {
  const size_t most = q->most_segments;
  const size_t keyframes = nsvcd__keyframes_after(m, 0);
  if (keyframes <= most) {
    nsvcd__choose_all(m, q);
    if (keyframes < 2 || q->segments < most) return 0;
  }
  nsvcd__choose_interval(m, q, 0, 1);
  if (q->begin[q->segments] < m->ticks) return 1;
  nsvcd__choose_all(m, q);
  return 0;
}

// The poses of a track in an interval, without ticks of their own.
static nsvcd__track nsvcd__subtrack(const nsvcd__track *track, uint32_t from, uint32_t until) {
  nsvcd__track part = *track;
  const uint32_t first = nsvcd__pose_before(track, from);
  if (track->count == 1) return part;
  part.poses += first;
  part.count = nsvcd__pose_before(track, until - 1) + 2 - first;
  return part;
}

// nsvcd__motion_gap of an interval.
static float nsvcd__interval_gap(const nsvcd__motion *m, uint32_t from, uint32_t until) {
  const nsvcd__track moving = nsvcd__subtrack(&m->moving, from, until);
  const nsvcd__track fixed = nsvcd__subtrack(&m->fixed, from, until);
  return nsvcd__tracks_gap(&moving, &fixed, m->unit);
}
#endif

// ============================================================== proof: the theorem, and its state

// ---------------------------------------------------------------------------------- proof/schedule
// In: nothing. Out: what a proof may take, and how much of it, in the order in which a query comes
// to it.

#ifndef NSVCD_NO_PROOF
// A budget is in units of work.

// Room for patch pairs as the search finds them; with so many of them they are sifted before it
// goes on.
#define NSVCD__FRESH 48
#define NSVCD__ENOUGH_FRESH 8

// Sifting tries planes and seeks witnesses. If the first patch pair is deeper than this, a witness
// is sought in it before any plane is tried.
#define NSVCD__DEEP 0.2f
// Steps of Gilbert's iteration, for a plane between two hulls.
#define NSVCD__PLANE_STEPS 12
// Witnesses that were sought in vain: after so many triangles are tried as well; after so many no
// more witnesses are sought where the question is yes or no.
#define NSVCD__FEW_MISSES 8
#define NSVCD__MANY_MISSES 128
// Remembered heights over the plane that held last: of moving patches, and of fixed ones.
#define NSVCD__HEIGHTS 256
#define NSVCD__FIXED_HEIGHTS 64

// What no plane separates is resolved by its triangles, arc by arc.
// Room for such patch pairs. When it is full, they are resolved first.
#define NSVCD__PATCH_PAIRS 256
// Blocks of a fixed patch that are loaded at once.
#define NSVCD__WINDOW 8
// An interval is halved for all its triangle pairs once these have been halved more often than
// this, if it is longer than this fraction of an arc.
#define NSVCD__FEW_PARTS 1
#define NSVCD__SHORTEST 0.015
// A plane is tried on all of two patches once it has separated so many of their triangle pairs in
// a row.
#define NSVCD__SHARED 4
// Parts of an arc that wait; halvings of an interval for one triangle pair; remembered poses.
#define NSVCD__ARC_PARTS 8
#define NSVCD__HALVINGS 40
#define NSVCD__KNOWN_POSES 8
// In units of all lengths: a distance in double that is 0; one that is too near to halve for.
#define NSVCD__SAME_POSITION 1e-13
#define NSVCD__TOO_NEAR 1e-9
// The reserve is 1 / this of the budget. It is all that is left after an unresolved pair; FIRST
// looks for later contacts with so many units.
#define NSVCD__AFTER_UNRESOLVED 8
#define NSVCD__AFTER_FIRST_UNRESOLVED 3000

// What else a question asks.
// The budget of the first attempt, before the two ends of the motion are tried by themselves.
#define NSVCD__BRIEF_BUDGET 6000
// The budget at each end.
#define NSVCD__END_BUDGET 1000
// The budget for triangles that meet where one body is inside the other.
#define NSVCD__INSIDE_BUDGET 200
// Times that the search for a first bound of the distance alternates between when and where the
// bodies are nearest.
#define NSVCD__TURNS 2
// A long motion. Intervals of many arcs, and hard ones, are first tried with this budget.
#define NSVCD__TRY 64
// An interval that takes no more than EASY is easy, and the next try has LARGER times as many arcs.
// After a try that failed it has SMALLER times fewer, and up to WAIT intervals have to be easy
// before the next try.
#define NSVCD__EASY 16
#define NSVCD__LARGER 4
#define NSVCD__SMALLER 8
#define NSVCD__WAIT 64
// The least distance is measured in passes, each so many times finer.
#define NSVCD__FINER 2
// Segments that are searched together where the first contact is sought.
#define NSVCD__IN_ORDER 4
// If that exhausts its budget, the motion is proven part by part: the length of the first one, in
// segments; and the budget of a part besides eight times that of the part before.
#define NSVCD__FIRST_PART 0.0625
#define NSVCD__PART_BUDGET 250

// With a slop: contacts at the start that are collected at once; directions in which they are
// undone; rounds of undoing what is met on the way out; and the fraction of the slop that is kept
// where a body is set down.
#define NSVCD__TOUCHES 26
#define NSVCD__PUSH_OUTS 6
#define NSVCD__DEEPEN 16
#define NSVCD__SET_DOWN 0.02
// The resolution of a float of an answer, in units of all lengths; a safe pose is so many of these
// before a contact.
#define NSVCD__LEAST_EPSILON 1.2e-7
#define NSVCD__EPSILONS 3

// Contact points are sought in so many patch pairs: the farthest along so many directions and, if
// their area's width is less than this fraction of its length, along two more across that.
#define NSVCD__CONTACT_PAIRS 64
#define NSVCD__AROUND 8
#define NSVCD__SUPPORTS 10
#define NSVCD__SLIM 0.3
// Containment: triangles that a ray may cross.
#define NSVCD__CROSSED 128
#define NSVCD__NEVER 1e300  // ticks
#endif                      // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- proof/proof
// In: two bodies of triangles and a motion. Out: a witness (two triangles that meet, and when), a
// certificate that the surfaces never do, or neither: undecided.
//
// THEOREM. Let both bodies be scaled and posed by the motions of motion/motion: between two
// poses the position is linear in t and the rotation a slerp. If the proof ends in FREE,
// then at no t in [0,1] do the surfaces of the two meshes come within the clearance of each other,
// and no component of one is contained in what closed components of the other enclose (a body
// declared open encloses nothing). src/proof/THEOREM.md walks through it. None of this is needed
// for bodies that never come as near as their extents and the clearance together: nsvcd__prove.
//   1. Every point of a surface lies in a piece of some patch (surface/surface). So it is enough
//      to separate each patch of one body from each of the other, at all times.
//   2. The broad phase leaves out only patches and segments of time in which the spheres over the
//      pieces stay apart. What it leaves is a *patch pair*: two patches in one segment. Every patch
//      pair is separated by one of the steps below, or the verdict is not FREE.
//   3. An *interval* of the motion is a segment or a part of one. Within it, a point x of the
//      moving body (body frame) leaves the chord between its positions at the two ends by no more
//      than nsvcd__deviation_of along any direction: the deviation of segments/segments, along a
//      plane's normal (within one arc of angle h of one body it is h^2 / 8 |x|, and nothing along
//      the axis). Let a plane have the moving side at both ends on one side, by more than that and
//      the clearance. A chord is convex: so the chords are there too, and with them all positions
//      in between.
//   4. Slabs: the plane is normal to a patch, or to a group of 16; each side's extent along it
//      follows from its slab. Hulls: any plane; a patch's pieces are within its margin of the hull
//      of its first vertices. Triangles: a plane for a triangle pair, two entries. The entries of a
//      patch name all triangles of its pieces, whole or in parts.
//   5. Rounding: every plane allows for NSVCD__ROUNDING of all lengths that enter a float
//      computation: that is `rounding`, in intervals and segments alike. Stored points are off by
//      the patch's margin or quantization error, and every plane in float allows for that, too.
//      Triangle pairs are separated in double, whole and as the caller gave them, whatever pieces
//      are stored. No NaN occurs: questions and bodies are checked to be finite and within bounds.
//      Only in hulls floats may overflow, and there a NaN separates nothing.
//   6. Containment is decided at t = 0, component by component: a component that is contained in
//      the other body at one time and not at another has crossed a surface in between. A component
//      is represented by one of its vertices, its seed. A ray from the seed counts the triangles
//      of the other body's closed components that it leaves and enters through, with their signs:
//      the sum is the winding number about the seed, 0 outside. A ray that passes an edge within
//      rounding, or within what triangles are off the mesh's, is given up for another one. Open
//      components enclose nothing. Where flaws are set aside (patches/solids), what counts is still
//      a cycle: each edge has its reverse. Or it has an even number of triangles at each edge, and
//      then a ray from inside crosses an odd number of them. Corners that were joined leave gaps
//      between edges, which the cycle closes by strips, nowhere farther from an edge than `gap`. A
//      ray that passes an edge within `gap` is given up as well, so that it crosses no strip; and
//      only planes decide what is so near to the surface. FREE then says that nothing crosses the
//      surface but through a gap. What is nearly a solid is no cycle: if most rays find a seed
//      inside it, that is UNDECIDED. Where a triangle is that near to the seed, the answer counts
//      only if planes separate all patches at t = 0: then the seed, the surface that was tested
//      and the true one are, patch by patch, on one side of a plane, and agree.
//
// A long motion is cut into intervals (motion/choice), and 2 to 5 are applied to each: the verdict
// is FREE if each of them is. Each begins at the tick at which the one before it ends, and the
// last ends at 1. Containment is decided at t = 0 alone: 6 holds for all of the motion.
//
// A witness is a pair of the meshes' triangles that share a point at the true pose, in double, or
// that come within the clearance, where there is one. In a coarse body, or a scaled one, they are
// those of a mesh that is a little off (nsvcd__off_mesh). Faces that are parallel when they meet
// do so at one time only, which rounded numbers miss. There, a corner that changes sides of the
// other triangle, within its edges all the while, has met it in between (so has an edge an edge),
// and halving finds when. UNDECIDED: two triangles come closer than NSVCD__TOO_NEAR and the
// tolerance without meeting, or the budget is exhausted. After such an unresolved pair only a
// contact can still decide, and flat on flat has as many unresolved pairs as triangles: so only a
// part of the budget is left then, more than a yes or no takes on any problem of the sets.
//
// FIRST CONTACT. A contact ends the motion: only what is more than `first` before it still matters,
// and is proven free, or gives an earlier contact, or is unresolved. Segments are searched a few at
// a time, in order, so that early contacts are found first. Once the budget after an unresolved
// pair is exhausted, that pair is the end, and what is before it is proven. If the budget does not
// suffice, the rest of it goes to what is proven soonest: the motion is proven part by part from
// where nothing is resolved, the first part a short one.
//
// THE LIMIT ends the search and changes nothing before that: what is tried, and in which order,
// depends on the units taken, not on those allowed. So a higher limit takes no more units for what
// a lower one decides, except in the lower one's last eighth, which is kept for what is undecided.
//
// THE LEAST DISTANCE is asked last, when it is known whether the bodies come within the clearance.
// Contacts lower the clearance: it begins as the distance of two vertices, and when triangles are
// found nearer than that, it becomes their distance less `measure`. What has been separated stays
// separated, by more than that. So it is one search whose question shrinks, and in the end all of
// the motion that matters is proven free at the clearance that matters.
//
// Work is counted in units: a plane sought for two hulls, 16 triangles against the box of 16, one
// of them against these, a triangle pair at one time, a ray against 16 triangles or one. Spheres,
// slabs and planes that held before are not counted. A query ends within one patch's entries, or
// one ray, of its limit: nsvcd__check_budget.

#ifndef NSVCD_NO_PROOF
typedef struct nsvcd__patch_pair {
  uint16_t moving, fixed, segment;
  uint16_t sought;  // 1: for a witness
  // 1 - least distance of the centres / (r1 + r2)
  float depth;
  // of the segment, when that is
  float fraction;
} nsvcd__patch_pair;

// The motion between two keyframes, in double and in the fixed body's units. Where the fixed body
// moves, slerps and positions have the world's axes, else the fixed body's.
typedef struct nsvcd__arc {
  // its first tick, and its length; no ticks: none
  uint32_t first, ticks;
  int fixed_moves;
  // of the moving body
  double scale;
  nsvcd__slerp moving, fixed;
  // from the fixed body's pivot to the moving one's, and how it changes
  nsvcd__d3 from, moved;
  // added to that in the fixed body's frame: its pivot, and the push-out; and taken away in the
  // moving one's
  nsvcd__d3 added, pivot;
  // The axis of the relative turn at the start, unit, in the fixed body's frame and in the moving
  // one's. Where both bodies turn, it wavers from either by this angle at most.
  nsvcd__d3 axis, own_axis;
  double waver;
  // Over the arc, in the fixed body's frame: the angle of the turn, radians, and the path of the
  // moving origin, at most.
  double turn, speed;
  // Deviation from the chord: per metre from the turn's axis; where both bodies turn, besides per
  // metre from the moving origin; and of that origin itself.
  double bend, twist, origin_bend;
} nsvcd__arc;

// The pose at fraction u of an arc, which its first tick and its ticks name.
typedef struct nsvcd__known_pose {
  uint32_t arc, ticks;
  double u;
  nsvcd__dtransform transform;
} nsvcd__known_pose;

// A motion, arc by arc: the arc that was asked for last, if it has ticks, and poses in arcs that
// are remembered, of which `next` is the next to be replaced.
typedef struct nsvcd__arcs {
  nsvcd__motion *motion;
  nsvcd__arc arc;
  nsvcd__known_pose poses[NSVCD__KNOWN_POSES];
  size_t next;
} nsvcd__arcs;

// An interval of the motion. A point of the moving body at r metres from its origin
// deviates from the chord between its positions at both ends by no more than origin_bend + bend r.
// Float computation of its position is off by no more than `rounding`.
typedef struct nsvcd__interval {
  nsvcd__transform start, end;
  float rounding, origin_bend, bend;
  // unit: of the turn from start to end, and of the origin's travel
  nsvcd__f3 axis, heading;
  // the bounds along the axis; and of the origin across the heading
  float bend_along_axis, origin_along_axis, origin_off_heading;
} nsvcd__interval;

// 16 triangles of a patch, lane by lane: corners (corner, axis, lane), and their boxes.
typedef struct nsvcd__block {
  float corners[3][3][NSVCD__LANES];
  float low[3][NSVCD__LANES], high[3][NSVCD__LANES];
  size_t patch, first, count;  // entries
} nsvcd__block;

// The triangles of a patch pair, block by block, with boxes about the fixed blocks.
typedef struct nsvcd__blocks {
  nsvcd__block moving, fixed[NSVCD__WINDOW];
  nsvcd__box bounds[NSVCD__WINDOW];
  // The moving block's corners at the start and at the end of the interval `over` (corner, axis,
  // lane); without an interval, NULL, 3 of them at one pose.
  const nsvcd__interval *over;
  float corners[6][3][NSVCD__LANES];
  // Only remembered, as a memo: blocks of a fixed patch in `fixed`; is one in `moving`?
  size_t corner_count, window;
  int has_block;
} nsvcd__blocks;

typedef struct nsvcd__pair_contact {
  double tick;      // when
  double distance;  // of the triangles
  // the fixed body's frame; out of the fixed body
  nsvcd__d3 point, normal;
  uint32_t moving_triangle, fixed_triangle;
  uint32_t moving_entry, fixed_entry;
  uint16_t moving_patch, fixed_patch;
} nsvcd__pair_contact;

// The velocity of the moving body in the fixed body's frame, per tick: that of a point x is
// along + cross(turn, x).
typedef struct nsvcd__twist {
  nsvcd__d3 along, turn;
} nsvcd__twist;

// Two triangles that touch at the start, in the fixed body's frame.
typedef struct nsvcd__touch {
  nsvcd__d3 moving[3], fixed[3];
  // Directions that may undo it, unit: the moving one's normal, reversed; the fixed one's normal;
  // and from the fixed one's nearest point to the moving one's, 0 if they meet.
  nsvcd__d3 directions[3];
} nsvcd__touch;

// Where the bodies touch at a contact: triangles/manifold.
typedef struct nsvcd__manifold {
  // unit: the contact's, and directions across it
  nsvcd__d3 normal, along[NSVCD__SUPPORTS];
  nsvcd__twist twist;
  // distances: of what touches, and of points that count as one, at most
  double tolerance, same;
  // The farthest contact along each direction; how far that is: -HUGE_VAL: there is none, HUGE_VAL:
  // it is not sought; and the number of its corner or edges.
  nsvcd__pair_contact supports[NSVCD__SUPPORTS];
  double farthest[NSVCD__SUPPORTS];
  uint32_t numbers[NSVCD__SUPPORTS];
} nsvcd__manifold;

// What is done with triangles that come within the clearance: they are contacts or, of a motion at
// rest, all are collected, as touching or as supports.
typedef enum nsvcd__collecting {
  NSVCD__CONTACTS,
  NSVCD__TOUCHING,
  NSVCD__SUPPORTING
} nsvcd__collecting;

// What a question finds.
typedef enum nsvcd__finding {
  NSVCD__FOUND_FREE,
  NSVCD__FOUND_CONTACT,
  NSVCD__FOUND_INSIDE,
  NSVCD__FOUND_UNDECIDED
} nsvcd__finding;

// What becomes of a part of it: a pair of patches, or of triangles, over an interval.
typedef enum nsvcd__outcome {
  // separated, or kept as an unresolved pair, or no longer asked about
  NSVCD__DONE,
  // the same of all triangles of both patches
  NSVCD__ALL_DONE,
  // a contact was sought and not found
  NSVCD__NOTHING,
  // a contact was found that answers the question
  NSVCD__ANSWERED,
  // a contact was found that shrinks the question: ask again
  NSVCD__SHRUNK,
  // ask again: in halves, or with a smaller clearance
  NSVCD__TOO_LONG,
  // the budget is exhausted, and stays so
  NSVCD__EXHAUSTED
} nsvcd__outcome;

// A patch's height over a plane. key: the patch; of a moving one, with the segment.
typedef struct nsvcd__height {
  uint32_t plane, key;
  float height;
} nsvcd__height;

// The question, in the fixed body's units.
typedef struct nsvcd__given {
  // the sum of both bodies' extents, and of their pivots' distances from the origins
  float lengths;
  // beyond the quantization errors
  double tolerance;
  double clearance, slop;
  // both bodies' convex radii, which the clearance includes
  double radius;
  // The resolution of the first contact, a fraction of the motion, and of the least distance; 0:
  // not asked for.
  double fraction, width;
  // FIRST: the resolution as a distance, so near a contact a motion may have ended; 0: not given
  double to;
  // is more asked for than yes or no?
  int tells;
  // The budget: of all or, if it grows, of each interval of a long motion; and the part of it for
  // what is beside the question, above all what follows an unresolved pair.
  size_t work, reserve;
  int grows;
} nsvcd__given;

// What one search is asked. A value: the search narrows a copy of its own, and only ever shrinks
// it, so that what has been proven holds for what is left. A contact is two triangles within the
// clearance.
typedef struct nsvcd__goal {
  nsvcd__motion *motion;
  // ticks: what begins then or later does not matter
  double end;
  // the first unresolved pair ends the search, too
  int unresolved_ends;
  double clearance;
  // DISTANCE: each contact lowers the clearance to the distance of its triangles less `measure`, 0:
  // not asked for; and the bracket of the least distance as it is known
  double measure, low, high;
  // FIRST: each contact ends the motion so much before it: a fraction of the motion, and in ticks;
  // 0: not asked for
  double fraction, first;
  // budgets: of this search, of all, and after an unresolved pair
  size_t limit, most, after_unresolved;
  // a first attempt, with a small budget
  int is_brief;
  nsvcd__collecting collects;
} nsvcd__goal;

// Why it could not be told what is inside of what: the rays do not tell, or the budget ended first.
typedef enum nsvcd__unclear {
  NSVCD__CLEAR,
  NSVCD__CANNOT_TELL,
  NSVCD__NOT_ASKED
} nsvcd__unclear;

// What a search has proven of a motion.
typedef struct nsvcd__search_result {
  nsvcd__outcome outcome;
  int has_contact;
  nsvcd__pair_contact found;
  // the tick at which the first unresolved pair begins (two triangles too near to tell); the pair
  double unresolved;
  nsvcd__pair_contact unresolved_pair;
  // the budget was exhausted: all from the tick `proven_until` on is undecided
  int ran_out;
  double proven_until;
  // the goal's end and clearance, as the search has narrowed them
  double end, clearance;
  // FIRST: nothing of the motion is proven free but its start
  int starts_free;
} nsvcd__search_result;

// What is only remembered of patch pairs. It may be forgotten between patch pairs and between parts
// of one: what is proven is as true then, and only the work may differ. All zeros: nothing is
// remembered.
typedef struct nsvcd__memo {
  // segments that have been made intervals
  uint64_t intervals;
  // The normal of the plane between hulls that held last, and its number, 0: none; and the heights
  // of moving and of fixed patches over it.
  nsvcd__f3 held;
  uint32_t plane;
  nsvcd__height heights[NSVCD__HEIGHTS], fixed_heights[NSVCD__FIXED_HEIGHTS];
} nsvcd__memo;

// With a slop: what the moving body touches at the start, and how that is undone.
typedef struct nsvcd__push_outs {
  // collected contacts that no known normal undoes; normals, unit, of what the moving body touches,
  // towards it
  size_t contact_count, normal_count;
  // One contact cannot be undone. Of directions that undo as many, the one with more faces is
  // chosen, not the one with the shorter push-out.
  int too_deep, by_faces;
  nsvcd__d3 normals[NSVCD__PUSH_OUTS];
  // the depth of contact along each; and how far a plane normal to one is to be pushed out
  double depths[NSVCD__PUSH_OUTS];
  double needed;
  double slop;  // how deep a contact may be that is undone
} nsvcd__push_outs;

// What two triangles need, and all that the floor `triangles` may write: the bodies and the
// question, which stay as they are given; the goal of the search now or the last one, and what it
// has found. Everywhere it is called p.
typedef struct nsvcd__proof {
  nsvcd__geometry moving, fixed;
  nsvcd__given given;
  // the goal's motion, in whose last arc patch pairs and triangle pairs are resolved
  nsvcd__arcs arcs;
  nsvcd__goal goal;
  nsvcd__search_result known;
  size_t work;
  // Only remembered, as a memo: the unit normal of the plane that separated a triangle pair last.
  // shared: the triangle pairs in a row that it has separated since.
  nsvcd__d3 separating;
  nsvcd__push_outs push;
  union {
    struct {
      // that no plane separates over their segment
      nsvcd__patch_pair pairs[NSVCD__PATCH_PAIRS];
      nsvcd__manifold manifold;
    } kept;
    // collected before there are any
    nsvcd__touch touches[NSVCD__TOUCHES];
  } of;
  // A triangle pair over an arc: the ends of the parts to come, the last one first. parts: how
  // often the interval's triangle pairs have been halved.
  double pair_ends[NSVCD__HALVINGS + 2];
  size_t shared, parts;
} nsvcd__proof;

// What patches need besides, which the floor `separate` writes. Everywhere it is called w, and its
// proof w->p.
typedef struct nsvcd__solver {
  nsvcd__proof p;
  nsvcd__isa isa;  // whose kernels search
  nsvcd__memo memo;

  // Containment at the start. inside: a component seems to be inside the other body, but close to
  // its surface; enclosed: a point of it, in the fixed body's frame; unclear: it could not be told,
  // in_open: since the other is nearly a solid, but not closed.
  int inside, in_open;
  nsvcd__d3 enclosed;
  nsvcd__unclear unclear;

  // Segments as intervals (S), where the memo says so. Those that have been clipped, and the end,
  // ticks, at which the last one was.
  nsvcd__interval *intervals;
  uint64_t clipped;
  double clipped_end;

  // segments in which 16 fixed patches are met
  uint64_t met_in[NSVCD__GROUP];
  // Patch pairs: as the search finds them, and those that no plane separates over their segment;
  // witnesses that were sought in vain; and how often a plane has been tried on all of both
  // patches.
  size_t fresh_count, count, misses, all_tried;
  nsvcd__patch_pair fresh[NSVCD__FRESH];

  // a patch pair: its hulls, posed, and its triangles
  float hull_start[3][NSVCD__LANES], hull_end[3][NSVCD__LANES], hull_fixed[3][NSVCD__LANES];
  nsvcd__blocks blocks;

  // A patch pair over an arc: the part now, and the ends of those to come, the last one first
  nsvcd__interval interval;
  double arc_ends[NSVCD__ARC_PARTS];

  // triangles that a ray has crossed
  uint32_t crossed[NSVCD__CROSSED];
} nsvcd__solver;

// The limit that allows so many units more, but never more than the question has left.
static size_t nsvcd__limit_after(const nsvcd__proof *p, const nsvcd__goal *goal,
                                 size_t units) {
  const size_t left = p->work < goal->most ? goal->most - p->work : 0;
  return left > units ? p->work + units : goal->most;
}

// The limit of the search for the first contact; the rest is for what is proven part by part.
static size_t nsvcd__limit_of_first(const nsvcd__given *given, const nsvcd__goal *goal) {
  return goal->most - given->reserve;
}

// Is the budget exhausted? FIRST looks for contacts after its first unresolved pair with a small
// budget. When that is exhausted, the pair becomes the end of the motion, here, and the search goes
// on with the rest of the budget for what lies before the pair.
static int nsvcd__check_budget(nsvcd__proof *p) {
  nsvcd__goal *goal = &p->goal;
  if (p->work > goal->limit && goal->first > 0 && !goal->is_brief && !goal->unresolved_ends &&
      p->known.unresolved < NSVCD__NEVER) {
    goal->unresolved_ends = 1;
    p->known.end = nsvcd__min(p->known.end, p->known.unresolved);
    const size_t left = (NSVCD__AFTER_UNRESOLVED - 1) * p->given.reserve;
    goal->limit = nsvcd__limit_of_first(&p->given, goal);
    if (p->work + left < goal->limit) goal->limit = p->work + left;
  }
  return p->work > goal->limit;
}

// The clearance in float, rounded up.
static float nsvcd__clearance(const nsvcd__goal *goal) {
  return 1.000001f * (float)goal->clearance;
}

// How far triangles may be off the meshes', both together.
static double nsvcd__off_meshes(const nsvcd__proof *p) {
  const double moving = (double)nsvcd__off_mesh(&p->moving);
  return p->arcs.motion->ratio * moving + (double)nsvcd__off_mesh(&p->fixed);
}

// The sum of two patches' quantization errors.
static float nsvcd__errors_of(const nsvcd__proof *p, size_t i, size_t j) {
  return p->arcs.motion->scale * p->moving.errors[i] + p->fixed.errors[j];
}

// Turns to a motion. None of its arcs is known, nor any pose.
static void nsvcd__arcs_begin(nsvcd__arcs *arcs, nsvcd__motion *motion) {
  memset(arcs, 0, sizeof *arcs);
  arcs->motion = motion;
}

// Answers in float cannot tell things apart that are nearer to each other than this.
static double nsvcd__epsilon(const nsvcd__proof *p) {
  return nsvcd__off_meshes(p) + NSVCD__LEAST_EPSILON * (double)p->given.lengths;
}
#endif  // NSVCD_NO_PROOF

// ============================================================= task: a question, and what it needs

// -------------------------------------------------------------------------------------- task/facts
// In: weights.h. Out: the names of what the decoder sees of two patches, and the tape: what the
// derivative of an opinion is made of.

#ifndef NSVCD_NO_NETWORK
// The facts: what the decoder sees of a pair's geometry, in the pair's frame and units.
enum {
  NSVCD__FACT_DISTANCE = 0,  // of the centres
  NSVCD__FACT_RADIUS = 1,    // the larger one
  NSVCD__FACT_CLOSEST = 2,   // the centres' distance at their closest approach
  NSVCD__FACT_TAU = 3,       // the time of that: -1 and 1 are the ends of the interval
  NSVCD__FACT_VELOCITY = 4,  // (3)
  NSVCD__FACT_TURN = 7,      // (3)
  NSVCD__FACT_SPEED = 10,    // the lengths of these two
  NSVCD__FACT_SPIN = 11,
  NSVCD__FACT_GAPS = 12,    // (GAPS, MOMENTS): between the extreme points
  NSVCD__FACT_WIDEST = 24,  // (MOMENTS): the widest of these
  // (3): products of the normals: with each other; the larger patch's, and the smaller one's, with
  // the line from the larger to the smaller
  NSVCD__FACT_FACING = 27,
  NSVCD__FACT_FLAT = 30,  // (2): how flat the larger patch is, and the smaller
  NSVCD__FACTS = 32
};
// The axes, from the fixed patch to the moving one, along which gaps are measured: the larger
// patch's normal, the smaller one's, the line between the centres, and the sum of the normals.
enum { NSVCD__GAP_LARGER, NSVCD__GAP_SMALLER, NSVCD__GAP_LINE, NSVCD__GAP_BOTH, NSVCD__GAPS };
#define NSVCD__MOMENTS 3  // both ends of the interval, and its middle
// The fact about a gap g, in units of r1 + r2, is x / (1 + |x|), where x is g times the first of
// these. The widest uses the second: near contact it must not be lost in the steps of int8.
#define NSVCD__GAP_STEEP 8.0f
#define NSVCD__WIDEST_STEEP 40.0f
#define NSVCD__INPUTS (2 * NSVCD__LATENT + NSVCD__FACTS)
// Zeros at the end.
#define NSVCD__DECODER_IN ((NSVCD__INPUTS + 15) / 16 * 16)
#define NSVCD__LEAN 0.05f  // share of the lean in axis 2

// A pair in motion: lane 0 of nsvcd__pairs, number by number, without the bytes.
typedef struct nsvcd__pair {
  nsvcd__f3 p1, p2;
  float r1, r2;
  nsvcd__mat3 rotation;
  nsvcd__f3 v, w, normal[2];
  float flat[2];
} nsvcd__pair;

// The pair in its own units, and its frame: lane 0 of nsvcd__views, number by number.
typedef struct nsvcd__view {
  float inverse, k1, k2, swap;
  nsvcd__f3 d, lean, normal;
  float time;
  nsvcd__f3 v, w;
  nsvcd__mat3 frame;
  float side;
} nsvcd__view;

// The times that matter of a candidate's motion.
enum {
  NSVCD__ENTRY = 0,
  NSVCD__EXIT = 1,
  NSVCD__MIDDLE = 2,       // of these two
  NSVCD__ENTRY_BEGIN = 3,  // the segment in which the balls meet
  NSVCD__ENTRY_END = 4,
  NSVCD__EXIT_BEGIN = 5,  // the segment in which they separate
  NSVCD__EXIT_END = 6,
  NSVCD__INSTANTS = 7
};

// The moving patch's centre at these times, in the fixed body's axes and units.
typedef struct nsvcd__instants {
  float t[NSVCD__INSTANTS];
  float arm[3][NSVCD__LANES];  // from the body's origin
  float position[3][NSVCD__LANES];
  // inside of the segment? At one of its ends the time is constant
  int enters, leaves;
} nsvcd__instants;

// What vectors compute for the derivative by one pair. network/tape records it, and gradient/ reads
// it in scalars.
typedef struct nsvcd__tape {
  nsvcd__pair pair;
  nsvcd__view view;
  nsvcd__f3 axes[NSVCD__GAPS];              // along which gaps are measured
  float gaps[NSVCD__MOMENTS][NSVCD__GAPS];  // in the fixed body's units
  const int8_t *extremes[2];                // (EXTREMES, 3) at a stride of GROUP
  nsvcd__instants at;                       // its times are given
  float x[NSVCD__DECODER_IN];               // the decoder's inputs
  float by_x[NSVCD__DECODER_IN];            // the derivative by these
} nsvcd__tape;
#endif  // NSVCD_NO_NETWORK

// --------------------------------------------------------------------------------------- task/task
// In: two bodies and a motion. Out: an answer, by proof (proof/proof) or by the network
// (NeuralSVCD, algorithm 1). This room has what a question needs, and its memory; query/question
// takes it through these phases:
//
//   check       is it in order, which method can answer it, and is the workspace large enough?
//   who moves   of its two bodies; all is computed in the other's frame and units
//   lay out     what it needs, and where in the workspace that is
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
// judges the K most suspicious. K is network.pairs, by default NSVCD_DEFAULT_PAIRS. The broad phase
// says how a motion is cut, into 16 to 64 segments; network/decoder how much goes through a decoder
// at once (NSVCD__BATCH, NSVCD__ROWS); and proof/proof what a proof may take.

// Pairs on the shortlist, times K. The tiny decoder needs none: K.
#define NSVCD__SHORTLIST 4
// New pairs that are worth a first run of the ranker before the search is done. Later runs wait for
// NSVCD__BATCH pairs.
#define NSVCD__FIRST_BATCH 8
// Pairs that runs before the end of the search may take, times the shortlist.
#define NSVCD__RANKED_TWICE 2
// Pairs that the chosen decoder gets at once, until one is clear; and pairs that are kept where the
// last of a batch collided.
#define NSVCD__PORTION 4
// By how much patches are inflated before planes separate them, as a fraction of their radii, at
// N = 32, and less the more patches there are: at a recall of 0.999, and of 0.9999.
#define NSVCD__INFLATE 0.04f
#define NSVCD__MOST_INFLATE 0.1f
// The same where a distance is asked for: the decoder knows distances up to a patch's radius.
#define NSVCD__INFLATE_DISTANCE 1.0f
// A logit this far from 0 is clear. A clear collision needs no second pair, and what is clear to
// the ranker no second decoder: 37,000 answers on held-out sets, N = 128 to 512, are the same as
// with twice this and twice the next, but for four.
#define NSVCD__CLEAR_LOGIT 3.0f
// The same in the first pair of groups, where planes are not asked yet: at 3, earlier weights
// stopped one more free motion of 2,000, 2 mm from contact.
#define NSVCD__FIRST_CLEAR 4.0f
// How often the patches where the last of a batch collided may mislead before they are forgotten.
#define NSVCD__MISLEADS 2

// The network's options, with the defaults filled in.
typedef struct nsvcd__settings {
  size_t pairs;      // K
  size_t shortlist;  // pairs that are kept
  const nsvcd__decoder *decoder, *ranker;
  int int8;
  float threshold;  // subtracted from the decoder's logit
  float inflate;    // as NSVCD__INFLATE, for these bodies
} nsvcd__settings;

// The candidate that an answer is about, and the decoder that gave its logit.
typedef struct nsvcd__decisive {
  nsvcd__candidate candidate;
  const nsvcd__decoder *decoder;
} nsvcd__decisive;

// The settings for two bodies of so many patches. On an error, where the options ask for what is
// not there, *settings is not whole. weights.h has a threshold per decoder, recall and N = 32, 64,
// ..., 512. Between those, and for two bodies that differ, it is interpolated at the mean of log2
// N.
static nsvcd_result nsvcd__settings_of(const nsvcd_network_options *o, size_t patches1,
                                       size_t patches2, nsvcd__settings *settings) {
  if (o->pairs > NSVCD_MAX_PAIRS) return NSVCD_ERROR_PAIRS;
  if ((unsigned)o->model > (unsigned)NSVCD_MODEL_BASE) return NSVCD_ERROR_MODEL;
  if (!nsvcd__is_finite(o->inflate) || o->inflate < 0) return NSVCD_ERROR_INFLATE;
  if (o->precision != NSVCD_PRECISION_FLOAT && o->precision != NSVCD_PRECISION_INT8)
    return NSVCD_ERROR_PRECISION;
  const nsvcd_model model = o->model ? o->model : NSVCD__LARGEST_MODEL;
  const size_t decoder = (size_t)model - (size_t)NSVCD_MODEL_TINY;
  if (!nsvcd_w_decoders[decoder].layers) return NSVCD_ERROR_MODEL;  // compiled out
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
  if (settings->int8) return NSVCD_ERROR_PRECISION;
#endif
  for (size_t k = 0; k < NSVCD_W_RECALLS && nsvcd__is_finite(o->recall); k++) {
    if (o->recall < nsvcd_w_recall[k] || o->recall > nsvcd_w_recall[k]) continue;
    const float n = sqrtf((float)patches1 * (float)patches2);
    const float last = NSVCD_W_SIZES - 1;
    const float size = log2f(n) - 5;
    const float at = size < 0 ? 0 : size > last ? last : size;
    const size_t row = at < last ? (size_t)at : NSVCD_W_SIZES - 2;
    const float low = nsvcd_w_threshold[decoder][row][k];
    const float high = nsvcd_w_threshold[decoder][row + 1][k];
    settings->threshold = low + (at - (float)row) * (high - low);
    const float least = k < 2 ? 0 : k == 2 ? NSVCD__INFLATE : NSVCD__MOST_INFLATE;
    settings->inflate = fmaxf(o->inflate, least * 32 / n);
    return NSVCD_OK;
  }
  return NSVCD_ERROR_RECALL;
}
#endif  // NSVCD_NO_NETWORK

// ---- tasks, and their memory

// A question that has been checked.
typedef struct nsvcd__task {
  const nsvcd_body *moving, *fixed;
  nsvcd__motion motion;
  int swapped;          // the moving body is b, not a
  float lengths;        // extents of both bodies and their pivots, in the fixed one's units
  nsvcd_method method;  // PROOF or NETWORK
  const nsvcd_question *question;
#ifndef NSVCD_NO_NETWORK
  nsvcd__settings settings;
  nsvcd__decisive *decisive;  // written unless NULL
#if NSVCD__SLICE == 1
  // (DECODER_IN) the decoder's inputs, in memory that the search does not need between two groups:
  // stack is scarce where rows go one by one
  float *row;
#endif
#endif
} nsvcd__task;

// What a workspace begins with. The network's memory and the proof's are the same, for one follows
// the other.
typedef struct nsvcd__query {
  nsvcd__isa isa;  // whose kernels answer
  nsvcd__search broad_phase;
  nsvcd__task task;
#ifndef NSVCD_NO_NETWORK
  nsvcd__candidate *kept;  // (shortlist)
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__solver *solver;
  nsvcd__interval *intervals;  // (S)
#endif
} nsvcd__query;

// NSVCD_PROOF_WORKSPACE_BYTES and NSVCD_NETWORK_WORKSPACE_BYTES count on these. Where this does not
// compile they are wrong.
#define NSVCD__MUST_HOLD(condition) ((condition) ? 1 : -1)
typedef char nsvcd__constants_hold[NSVCD__MUST_HOLD(
    sizeof(nsvcd__query) + 3 * NSVCD_ALIGNMENT + NSVCD__PASSED_OVER <= 1088 &&
    sizeof(nsvcd__segments) <= 148 * 16 && sizeof(nsvcd__chords) <= 512 &&
    sizeof(nsvcd__cut) <= 16 * 512 && NSVCD__TILE_SLOTS == 32 &&
    NSVCD_ALIGNMENT == sizeof(uint64_t))];
#ifndef NSVCD_NO_PROOF
typedef char nsvcd__proof_constants_hold[NSVCD__MUST_HOLD(sizeof(nsvcd__solver) <= 24832 &&
                                                          sizeof(nsvcd__interval) <= 168)];
#endif
#ifndef NSVCD_NO_NETWORK
typedef char nsvcd__network_constants_hold[NSVCD__MUST_HOLD(
    NSVCD__SHORTLIST * sizeof(nsvcd__candidate) <= 112 && NSVCD__LATENT == 40 &&
    sizeof(nsvcd__plane_cache) <= 576)];
#endif

// Lays a query out at `base`, which is aligned, or only counts if that is NULL. Returns the bytes
// that it takes.
static size_t nsvcd__query_layout(const nsvcd__needs *needs, char *base) {
  nsvcd__query counted;
  uint64_t used = 0;
  nsvcd__query *query = NSVCD__TAKE_ROWS(nsvcd__query, 1, base, &used);
  if (!query) query = &counted;
  nsvcd__search_layout(needs, base, &used, &query->broad_phase);
  uint64_t end = used;
#ifndef NSVCD_NO_NETWORK
  nsvcd__search *search = &query->broad_phase;
  const size_t asked = needs->candidates > 0;
  const size_t meetings = asked * NSVCD__GROUP * needs->segments;
  query->kept = NSVCD__TAKE_ROWS(nsvcd__candidate, needs->candidates, base, &end);
  search->cache = NSVCD__TAKE_ROWS(nsvcd__plane_cache, asked, base, &end);
  search->met = NSVCD__TAKE_ROWS(uint16_t, meetings, base, &end);
#endif
#ifndef NSVCD_NO_PROOF
  const size_t proofs = needs->proof != 0;
  const size_t intervals = proofs * needs->segments;
  query->solver = NSVCD__TAKE_ROWS(nsvcd__solver, proofs, base, &used);
  query->intervals = NSVCD__TAKE_ROWS(nsvcd__interval, intervals, base, &used);
#endif
  return (size_t)(used > end ? used : end);
}

// Writes what a verdict alone tells: the bodies may go to the end of a motion that is free, else
// nowhere.
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

// Where the last question of a batch collided, by the network: the next one is tried there first.
// Forgotten when it has misled MISLEADS times, or the bodies change.
typedef struct nsvcd__hint {
  int known, misled;
  uint32_t moving, fixed;  // patches
} nsvcd__hint;

#endif  // NSVCD__ISA

// ===================================================================== lanes: 16 numbers at a time

// ------------------------------------------------------------------------------------- lanes/lanes
// In, out: slices of 16 lanes: as many floats as a register holds. v is a slice, v3 a vector of
// three of them.

// ---- operations, for each instruction set; the plain C ones say what they mean. Macros, so that
// the sets of x86 share one text, which entry/processor compiles three times.

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
// pmin(b, a) is a < b ? a : b, one instruction of x86; min, which handles NaN and -0, takes many.
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
// With a mask of all lanes: unmasked, gcc's own header warns in C++.
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
// Bit i is set if a <= b in lane i of the slice, or a < b.
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
static inline nsvcd__v nsvcd__v_load_int8(const int8_t *p) {
#if NSVCD__SLICE == 1
  return (float)*p;
#elif defined(__wasm_simd128__)
  const v128_t wide = wasm_i16x8_extend_low_i8x16(wasm_v128_load32_zero(p));
  return wasm_f32x4_convert_i32x4(wasm_i32x4_extend_low_i16x8(wide));
#elif NSVCD__SLICE == 4
  int32_t word;
  memcpy(&word, p, sizeof word);
#if defined(__aarch64__)
  const int16x8_t wide = vmovl_s8(vcreate_s8((uint64_t)(uint32_t)word));
  return vcvtq_f32_s32(vmovl_s16(vget_low_s16(wide)));
#else
  const __m128i packed = _mm_cvtsi32_si128(word);
  const __m128i pairs = _mm_unpacklo_epi8(packed, packed);
  return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(pairs, pairs), 24));
#endif
#elif NSVCD__SLICE == 8
  const __m128i packed = _mm_loadl_epi64((const __m128i *)(const void *)p);
  return _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(packed));
#else
  const __m128i packed = _mm_loadu_si128((const __m128i *)(const void *)p);
  const __m512i wide = _mm512_maskz_cvtepi8_epi32(NSVCD__ALL, packed);
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

// A slice of vectors.
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
#define NSVCD__BY_AXIS(op, a, b) nsvcd__v3_of(op(a.x, b.x), op(a.y, b.y), op(a.z, b.z))
NSVCD__INLINE nsvcd__v3 nsvcd__v3_add(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_add, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_sub(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_sub, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_negate(nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v_negate(a.x), nsvcd__v_negate(a.y), nsvcd__v_negate(a.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_min(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_min, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_max(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_max, a, b);
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
NSVCD__INLINE nsvcd__v nsvcd__v3_norm(nsvcd__v3 a) {
  return nsvcd__v_sqrt(nsvcd__v3_dot(a, a));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_cross(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_sub(nsvcd__v_mul(a.y, b.z), nsvcd__v_mul(a.z, b.y)),
                      nsvcd__v_sub(nsvcd__v_mul(a.z, b.x), nsvcd__v_mul(a.x, b.z)),
                      nsvcd__v_sub(nsvcd__v_mul(a.x, b.y), nsvcd__v_mul(a.y, b.x)));
}
// The centres of a slice of spheres.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_centres(nsvcd__spheres all, size_t l) {
  return nsvcd__v3_of(nsvcd__v_load(all.x + l), nsvcd__v_load(all.y + l),
                      nsvcd__v_load(all.z + l));
}
// From rows of x, y and z, `stride` apart.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_get(const float *p, size_t stride) {
  return nsvcd__v3_of(nsvcd__v_load(p), nsvcd__v_load(p + stride),
                      nsvcd__v_load(p + 2 * stride));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_load_int8(const int8_t *p, size_t stride) {
  return nsvcd__v3_of(nsvcd__v_load_int8(p), nsvcd__v_load_int8(p + stride),
                      nsvcd__v_load_int8(p + 2 * stride));
}
NSVCD__INLINE void nsvcd__v3_put(nsvcd__v3 a, float *p, size_t stride) {
  nsvcd__v_store(p, a.x);
  nsvcd__v_store(p + stride, a.y);
  nsvcd__v_store(p + 2 * stride, a.z);
}
// From three rows of 16 numbers.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_rows(const float *p) {
  return nsvcd__v3_get(p, NSVCD__LANES);
}
// Lanes l .. l + SLICE - 1 of p (3, LANES).
NSVCD__INLINE void nsvcd__v3_store(nsvcd__row *p, size_t l, nsvcd__v3 a) {
  nsvcd__v3_put(a, p[0] + l, NSVCD__LANES);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_load(nsvcd__row *p, size_t l) {
  return nsvcd__v3_get(p[0] + l, NSVCD__LANES);
}

// Unit vectors; the x axis where the length is 0.
static inline nsvcd__v3 nsvcd__v3_unit(nsvcd__v3 a) {
  const nsvcd__v3 x = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v least = nsvcd__v_set(1e-18f);
  const nsvcd__v length = nsvcd__v3_norm(a);
  const nsvcd__v inverse = nsvcd__v_div(x.x, nsvcd__v_max(length, least));
  const nsvcd__v3 unit = nsvcd__v3_scale(a, inverse);
  return nsvcd__v3_of(nsvcd__v_pick(length, least, x.x, unit.x),
                      nsvcd__v_pick(length, least, x.y, unit.y),
                      nsvcd__v_pick(length, least, x.z, unit.z));
}

// Ranges along a direction.
typedef struct nsvcd__v_range {
  nsvcd__v low, high;
} nsvcd__v_range;

// The square of a sum of radii, with its sign: a negative sum, of padding, meets nothing.
static inline nsvcd__v nsvcd__v_signed_square(nsvcd__v sum) {
  return nsvcd__v_mul(sum, nsvcd__v_abs(sum));
}

// A ray in a body's frame, with a radius.
typedef struct nsvcd__beam {
  nsvcd__f3 from, along;  // along: a unit vector
  float width;
} nsvcd__beam;

// A filter of a traversal: spheres that a beam meets.
static uint32_t nsvcd__is_on_beam(const void *what, nsvcd__spheres all) {
  const nsvcd__beam *beam = (const nsvcd__beam *)what;
  const nsvcd__v3 n = nsvcd__v3_set(beam->along);
  const nsvcd__v3 from = nsvcd__v3_set(beam->from);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), from);
    const nsvcd__v3 off = nsvcd__v3_cross(d, n);
    const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(all.r + l), beam->width);
    const nsvcd__v square = nsvcd__v3_dot(off, off);
    const uint32_t ahead = nsvcd__v_le(nsvcd__v_negate(sum), nsvcd__v3_dot(d, n));
    met |= (ahead & nsvcd__v_le(square, nsvcd__v_signed_square(sum))) << l;
  }
  return met;
}

// ------------------------------------------------------------------------------------- lanes/turns
// In, out: rotations, lane by lane: vquat is a slice of quaternions, vmat3 of matrices.

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
// The axis of a unit quaternion, times the sine of half its angle.
NSVCD__INLINE nsvcd__v3 nsvcd__vquat_axis(nsvcd__vquat q) {
  return nsvcd__v3_of(q.x, q.y, q.z);
}
NSVCD__INLINE nsvcd__vquat nsvcd__vquat_set(nsvcd__quat q) {
  return nsvcd__vquat_of(nsvcd__v3_set(nsvcd__f3_of(q.x, q.y, q.z)), nsvcd__v_set(q.w));
}
// From rows of x, y, z and w, `stride` apart.
NSVCD__INLINE nsvcd__vquat nsvcd__vquat_load(const float *p, size_t stride) {
  return nsvcd__vquat_of(nsvcd__v3_get(p, stride), nsvcd__v_load(p + 3 * stride));
}
NSVCD__INLINE void nsvcd__vquat_store(nsvcd__vquat q, float *p, size_t stride) {
  nsvcd__v3_put(nsvcd__vquat_axis(q), p, stride);
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
// Of unit quaternions.
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
  const nsvcd__vmat3 out = {nsvcd__v3_set(m->x), nsvcd__v3_set(m->y), nsvcd__v3_set(m->z)};
  return out;
}
// p: (9, LANES), row-major.
NSVCD__INLINE nsvcd__vmat3 nsvcd__vmat3_load(nsvcd__row *p, size_t l) {
  return nsvcd__vmat3_rows(nsvcd__v3_load(p, l), nsvcd__v3_load(p + 3, l),
                           nsvcd__v3_load(p + 6, l));
}
NSVCD__INLINE void nsvcd__vmat3_store(nsvcd__row *p, size_t l, nsvcd__vmat3 m) {
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
// The squared Frobenius norm.
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

// Of quaternions of any length whose square fits a float.
static inline nsvcd__vmat3 nsvcd__vmat3_of(nsvcd__vquat q) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v3 axis = nsvcd__vquat_axis(q);
  const nsvcd__v square = nsvcd__v_add(nsvcd__v_mul(q.w, q.w), nsvcd__v3_dot(axis, axis));
  const nsvcd__v3 s = nsvcd__v3_scale(axis, nsvcd__v_div(nsvcd__v_set(2), square));
  // twice x times each, twice w times each, and the products that are left
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

// ================================================================ segments: 16 parts of a motion

// ------------------------------------------------------------------------------- segments/segments
// In: a motion, and the ticks at which its segments begin. Out: for 16 segments at a time the
// moving body's pose at the start, its change until the end, and how far points deviate from that.
//
// Within a segment a point c of the moving body, in its frame, is taken along the chord between its
// positions at both ends, x0 + tau v, tau in [0,1]. Its true position M(t) c + p(t), where M is the
// rotation times the scale, is no farther from the chord's than
//   origin_bend + bend |c|
// Proof: let L(t) interpolate M linearly between the segment's ends, K(t) piecewise between the
// keyframes inside. Between two keyframes a chord misses a curve by at most max|second derivative|
// / 8, with time from 0 to 1 there. If one body moves, that is h^2 |c| / 8 on an arc of angle h,
// and its origin moves straight; if both do, see nsvcd__cut_double_arc. K - L is piecewise linear
// and its norm convex, so it is largest at a keyframe. Hence
//   bend        = max over arcs of their bend per metre
//                 + max over keyframes ||M_k - L(t_k)||  (Frobenius >= 2-norm)
//   origin_bend = max over arcs of the origin's bend
//                 + max over keyframes |p_k - its linear interpolation|
//   margin      = origin_bend + rounding + the clearance asked for
//
// A body that turns about a pivot is one whose origin is there, with points shifted by -pivot: so
// its origin is no farther from its chord than its arcs bend times |pivot| more.
//
// Along a direction n, |n| <= 1, the deviation is smaller. A turn by h about the unit axis a bends
// the path of a point x by a x (a x y) h^2, y being x, turned; and n.(a x (a x y)) = (n x a).(a x
// y), at most |n x a| |x|: nothing along the axis. `bend_along_axis` and `origin_along_axis` are
// what is left along the axis of the whole segment's turn, from which the axes of its arcs may
// differ. nsvcd__deviation_of puts them together.

// A slice of poses of both bodies in the world.
typedef struct nsvcd__v_poses {
  nsvcd__vquat moving;  // of any length
  nsvcd__vquat fixed;   // unit; only where that body moves
  nsvcd__v3 offset;     // from the fixed body's pivot to the moving one's, metres
} nsvcd__v_poses;

// A slice of poses.
typedef struct nsvcd__v_pose {
  nsvcd__vquat rotation;
  nsvcd__v3 position;
} nsvcd__v_pose;

// The moving body's poses in the fixed body's frame: quaternions of any length, positions in its
// units.
static nsvcd__v_pose nsvcd__v_seen(const nsvcd__motion *m, const nsvcd__v_poses *at) {
  const nsvcd__v per_metre = nsvcd__v_set(1 / m->unit);
  nsvcd__vquat to_fixed;
  nsvcd__vmat3 matrix;
  if (m->fixed_moves) {
    to_fixed = nsvcd__vquat_inverse(at->fixed);
    matrix = nsvcd__vmat3_of(to_fixed);
  } else {
    to_fixed = nsvcd__vquat_set(m->to_fixed_quat);
    matrix = nsvcd__vmat3_set(&m->to_fixed);
  }
  const nsvcd__v3 metres = nsvcd__vmat3_apply(matrix, at->offset);
  nsvcd__v_pose out;
  out.rotation = nsvcd__vquat_mul(to_fixed, at->moving);
  out.position = nsvcd__v3_fma(per_metre, metres, nsvcd__v3_set(m->push_out));
  if (m->fixed.pivot) {
    const nsvcd__v3 pivot = nsvcd__v3_set(nsvcd__f3_load(m->fixed.pivot));
    out.position = nsvcd__v3_add(out.position, pivot);
  }
  if (m->moving.pivot) {
    const nsvcd__v3 pivot = nsvcd__v3_set(nsvcd__f3_load(m->moving.pivot));
    const nsvcd__v3 arm = nsvcd__vmat3_apply(nsvcd__vmat3_of(out.rotation), pivot);
    out.position = nsvcd__v3_fma(nsvcd__v_set(-m->scale), arm, out.position);
  }
  return out;
}

// ---- turns between quaternions

// 1 where x >= 0, else -1.
static nsvcd__v nsvcd__v_sign(nsvcd__v x) {
  return nsvcd__v_pick(nsvcd__v_set(0), x, nsvcd__v_set(1), nsvcd__v_set(-1));
}

// An upper bound of the angle between two rotations, unit to 1e-4, tight where it is small: 4
// asin(chord / 2) of their chord as quaternions, with asin x <= x + (pi/2 - 1) x^3, and half a
// thousandth for the lengths.
static nsvcd__v nsvcd__v_arc(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__vquat_dot(a, b));
  const nsvcd__vquat chord = nsvcd__vquat_fma(nsvcd__v_negate(sign), b, a);
  const nsvcd__v length = nsvcd__v_sqrt(nsvcd__vquat_dot(chord, chord));
  const nsvcd__v x = nsvcd__v_scale(length, 0.50025f);
  const nsvcd__v square = nsvcd__v_mul(x, x);
  return nsvcd__v_mul(x, nsvcd__v_fma(nsvcd__v_set(2.2832f), square, nsvcd__v_set(4)));
}

// The vector part of b a^-1: the axis of the turn from a to b, times the sine of half its angle.
static nsvcd__v3 nsvcd__v_turn(nsvcd__vquat a, nsvcd__vquat b) {
  const nsvcd__v3 u = nsvcd__vquat_axis(a);
  const nsvcd__v3 v = nsvcd__vquat_axis(b);
  const nsvcd__v3 sum = nsvcd__v3_fma(nsvcd__v_negate(b.w), u, nsvcd__v3_cross(u, v));
  return nsvcd__v3_fma(a.w, v, sum);
}

// The same on the shorter arc. cosine: of half the angle; near 0, rounding may have taken the
// longer one.
static nsvcd__v3 nsvcd__v_shorter_turn(nsvcd__vquat a, nsvcd__vquat b, nsvcd__v *cosine) {
  const nsvcd__v dot = nsvcd__vquat_dot(a, b);
  const nsvcd__v sign = nsvcd__v_sign(dot);
  *cosine = nsvcd__v_mul(sign, dot);
  return nsvcd__v3_scale(nsvcd__v_turn(a, b), sign);
}

// ---- keyframes

// Reads the poses of both bodies at `count` ticks.
static void nsvcd__keyframes_read(const nsvcd__motion *m, const uint32_t *ticks, size_t count,
                                  nsvcd__keyframes *out) {
  nsvcd__world_pose fixed = {{0, 0, 0, 1}, nsvcd__d3_widen(m->fixed_position)};
  for (size_t l = 0; l < count; l++) {
    const nsvcd__world_pose moving = nsvcd__track_pose(&m->moving, ticks[l]);
    nsvcd__quat_put(moving.rotation, out->moving + l, NSVCD__ENDS);
    if (m->fixed_moves) {
      fixed = nsvcd__track_pose(&m->fixed, ticks[l]);
      nsvcd__quat_put(fixed.rotation, out->fixed + l, NSVCD__ENDS);
    }
    const nsvcd__d3 offset = nsvcd__d3_sub(moving.position, fixed.position);
    nsvcd__f3_put(nsvcd__d3_narrow(offset), out->offset + l, NSVCD__ENDS);
  }
}

// A slice of them from lane l on; l may be 1, for there is one keyframe more than lanes.
static nsvcd__v_poses nsvcd__keyframes_load(const nsvcd__motion *m,
                                            const nsvcd__keyframes *from, size_t l) {
  nsvcd__v_poses out;
  out.offset = nsvcd__v3_get(from->offset + l, NSVCD__ENDS);
  out.moving = nsvcd__vquat_load(from->moving + l, NSVCD__ENDS);
  out.fixed = out.moving;
  if (m->fixed_moves) {
    out.moving = nsvcd__vquat_unit(out.moving);
    out.fixed = nsvcd__vquat_unit(nsvcd__vquat_load(from->fixed + l, NSVCD__ENDS));
  }
  return out;
}

// Stores a slice with its rotations in the fixed body's frame.
static void nsvcd__keyframes_store(const nsvcd__motion *m, const nsvcd__v_poses *at,
                                   nsvcd__vquat seen, size_t l, nsvcd__keyframes *out) {
  nsvcd__vquat_store(at->moving, out->moving + l, NSVCD__ENDS);
  nsvcd__vquat_store(seen, out->seen + l, NSVCD__ENDS);
  if (!m->fixed_moves) return;
  nsvcd__v3_put(at->offset, out->offset + l, NSVCD__ENDS);
  nsvcd__vquat_store(at->fixed, out->fixed + l, NSVCD__ENDS);
}

// Rotations times the scale.
NSVCD__INLINE nsvcd__vmat3 nsvcd__v_scaled(const nsvcd__motion *m, nsvcd__vquat q) {
  return nsvcd__vmat3_scale(nsvcd__vmat3_of(q), nsvcd__v_set(m->scale));
}

// ---- the deviation of arcs and of keyframes

static void nsvcd__v_keep(float *most, nsvcd__v value) {
  nsvcd__v_store(most, nsvcd__v_max(nsvcd__v_load(most), value));
}
static void nsvcd__v_add_to(float *sum, nsvcd__v value) {
  nsvcd__v_store(sum, nsvcd__v_add(nsvcd__v_load(sum), value));
}

// An arc in which both bodies move. With w and w' the rotation vectors of the moving and the fixed
// body over the arc, in the world, o = w - w', and d the vector from the fixed origin to the moving
// one, which moves by v, the second derivative of a point x in the fixed body's frame is
//   o x (o x Rx) + (o x w') x Rx   -   2 w' x v + w' x (w' x d)
// so that the arc leaves its chord by (|o|^2 + |o x w'|) / 8 |x| and (2 |w' x v| + |w'| |w' x d|) /
// 8 at most.
static void nsvcd__cut_double_arc(const nsvcd__motion *m, const nsvcd__v_poses *from,
                                  const nsvcd__v_poses *to, size_t l, nsvcd__bends *most) {
  const nsvcd__v eighth = nsvcd__v_set(0.12501f);
  nsvcd__v cosine;
  nsvcd__v fixed_cosine;
  const nsvcd__v3 half = nsvcd__v_shorter_turn(from->moving, to->moving, &cosine);
  const nsvcd__v3 fixed_half = nsvcd__v_shorter_turn(from->fixed, to->fixed, &fixed_cosine);
  const nsvcd__v sine = nsvcd__v3_norm(half);
  const nsvcd__v fixed_sine = nsvcd__v3_norm(fixed_half);
  const nsvcd__v sines = nsvcd__v_add(sine, fixed_sine);
  const nsvcd__v least_cosine = nsvcd__v_min(cosine, fixed_cosine);
  const nsvcd__v apart = nsvcd__v3_norm(nsvcd__v3_sub(half, fixed_half));
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
  nsvcd__v_keep(most->arc_bend + l, nsvcd__v_mul(squares, eighth));

  const nsvcd__v start = nsvcd__v3_norm(from->offset);
  const nsvcd__v extent = nsvcd__v_max(start, nsvcd__v3_norm(to->offset));
  const nsvcd__v travel = nsvcd__v3_norm(nsvcd__v3_sub(to->offset, from->offset));
  const nsvcd__v both = nsvcd__v_fma(fixed_turn, extent, nsvcd__v_add(travel, travel));
  const nsvcd__v metres = nsvcd__v_mul(nsvcd__v_mul(fixed_turn, both), eighth);
  const nsvcd__v origin_bend = nsvcd__v_div(metres, nsvcd__v_set(m->unit));
  nsvcd__v_keep(most->arc_origin + l, origin_bend);
  nsvcd__v_add_to(most->turn + l, fixed_turn);
}

// Adds the arc from the last keyframes to these, which become the last. seen: their rotations in
// the fixed body's frame.
static void nsvcd__cut_arc(const nsvcd__motion *m, const nsvcd__v_poses *at, nsvcd__vquat seen,
                           size_t l, nsvcd__segments *out, nsvcd__cut *cut) {
  nsvcd__bends *most = &cut->most;
  const nsvcd__v_poses last = nsvcd__keyframes_load(m, &cut->last, l);
  const nsvcd__v arc = nsvcd__v_arc(last.moving, at->moving);
  nsvcd__v_add_to(most->turn + l, arc);
  if (m->fixed_moves) {
    nsvcd__cut_double_arc(m, &last, at, l, most);
  } else {
    // Along the axis: h^2 / 8 |axis x a| of a turn by h about a. With w = a sin(h / 2) that is at
    // most pi / 8 h |axis x w|.
    const nsvcd__vquat last_seen = nsvcd__vquat_load(cut->last.seen + l, NSVCD__ENDS);
    const nsvcd__v3 w = nsvcd__v_turn(last_seen, seen);
    const nsvcd__v3 across = nsvcd__v3_cross(nsvcd__v3_load(out->axis, l), w);
    const nsvcd__v most_along = nsvcd__v_scale(arc, 0.3931f);
    const nsvcd__v along = nsvcd__v_mul(most_along, nsvcd__v3_norm(across));
    nsvcd__v_keep(most->arc_bend + l, nsvcd__v_scale(nsvcd__v_mul(arc, arc), 0.125f));
    nsvcd__v_keep(most->arc_along_axis + l, along);
  }
  nsvcd__keyframes_store(m, at, seen, l, &cut->last);
}

// Visits a keyframe of each segment: ticks (16), begin (17) as nsvcd__cut_block has it. Adds the
// arc before it, and how far it is off its segment's chord.
static NSVCD__NOINLINE void nsvcd__cut_keyframe(const nsvcd__motion *m, const uint32_t *begin,
                                                const uint32_t *ticks, nsvcd__segments *out,
                                                nsvcd__cut *cut) {
  nsvcd__bends *most = &cut->most;
  nsvcd__row fraction;  // of the segment, before the keyframe
  nsvcd__keyframes_read(m, ticks, NSVCD__LANES, &cut->here);
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const uint32_t length = begin[l + 1] - begin[l];
    fraction[l] = length ? (float)(ticks[l] - begin[l]) / (float)length : 0;
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(m, &cut->here, l);
    const nsvcd__v_pose seen = nsvcd__v_seen(m, &at);
    nsvcd__cut_arc(m, &at, seen.rotation, l, out, cut);
    const nsvcd__v u = nsvcd__v_load(fraction + l);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__vmat3 turned = nsvcd__vmat3_load(out->turned, l);
    const nsvcd__vmat3 scaled = nsvcd__v_scaled(m, seen.rotation);
    const nsvcd__vmat3 off = nsvcd__vmat3_sub(scaled, nsvcd__vmat3_fma(u, turned, start));
    const nsvcd__v3 position = nsvcd__v3_load(out->position, l);
    const nsvcd__v3 chord = nsvcd__v3_fma(u, nsvcd__v3_load(out->moved, l), position);
    const nsvcd__v3 aside = nsvcd__v3_sub(seen.position, chord);
    nsvcd__v_keep(most->off + l, nsvcd__vmat3_square(off));
    nsvcd__v_keep(most->origin_off + l, nsvcd__v3_dot(aside, aside));

    const nsvcd__v3 axis = nsvcd__v3_load(out->axis, l);
    const nsvcd__v3 along = nsvcd__vmat3_apply_transpose(off, axis);
    const nsvcd__v3 across = nsvcd__v3_cross(nsvcd__v3_load(out->heading, l), aside);
    const nsvcd__v height = nsvcd__v3_dot(axis, aside);
    nsvcd__v_keep(most->along_axis + l, nsvcd__v3_dot(along, along));
    nsvcd__v_keep(most->origin_along_axis + l, nsvcd__v_mul(height, height));
    nsvcd__v_keep(most->origin_off_heading + l, nsvcd__v3_dot(across, across));
  }
}

// ---- segments

// Poses at the starts of 16 segments; at their ends, if `to` is 1.
static NSVCD__NOINLINE void nsvcd__cut_poses(const nsvcd__motion *m,
                                             const nsvcd__keyframes *here, size_t to,
                                             nsvcd__row *rotation, nsvcd__row *position,
                                             nsvcd__keyframes *out) {
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses at = nsvcd__keyframes_load(m, here, l + to);
    const nsvcd__v_pose seen = nsvcd__v_seen(m, &at);
    nsvcd__keyframes_store(m, &at, seen.rotation, l, out);
    nsvcd__vmat3_store(rotation, l, nsvcd__v_scaled(m, seen.rotation));
    nsvcd__v3_store(position, l, seen.position);
  }
}

// Sets the poses at the segments' starts, and their change until the ends: begin (17).
static NSVCD__NOINLINE void nsvcd__cut_ends(const nsvcd__motion *m, const uint32_t *begin,
                                            nsvcd__segments *out, nsvcd__cut *cut) {
  nsvcd__keyframes_read(m, begin, NSVCD__ENDS, &cut->here);
  nsvcd__cut_poses(m, &cut->here, 0, out->rotation, out->position, &cut->last);
  nsvcd__cut_poses(m, &cut->here, 1, out->turned, out->moved, &cut->end);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__vquat from = nsvcd__vquat_load(cut->last.seen + l, NSVCD__ENDS);
    const nsvcd__vquat to = nsvcd__vquat_load(cut->end.seen + l, NSVCD__ENDS);
    const nsvcd__vmat3 start = nsvcd__vmat3_load(out->rotation, l);
    const nsvcd__vmat3 end = nsvcd__vmat3_load(out->turned, l);
    const nsvcd__v3 position = nsvcd__v3_load(out->position, l);
    const nsvcd__v3 moved = nsvcd__v3_sub(nsvcd__v3_load(out->moved, l), position);
    nsvcd__vmat3_store(out->turned, l, nsvcd__vmat3_sub(end, start));
    nsvcd__v3_store(out->moved, l, moved);
    nsvcd__v3_store(out->axis, l, nsvcd__v3_unit(nsvcd__v_turn(from, to)));
    nsvcd__v3_store(out->heading, l, nsvcd__v3_unit(moved));
  }
}

// What arcs are off, times the arm, plus what keyframes are, whose square is given.
static nsvcd__v nsvcd__v_bend(nsvcd__v arm, const float *arcs, const float *keyframes) {
  const nsvcd__v off = nsvcd__v_sqrt(nsvcd__v_load(keyframes));
  return nsvcd__v_add(off, nsvcd__v_mul(arm, nsvcd__v_load(arcs)));
}

// Sets the deviations, once all keyframes have been visited. If both bodies move, they are not
// smaller along any direction.
static void nsvcd__cut_deviations(const nsvcd__motion *m, float lengths, size_t l,
                                  nsvcd__segments *out, const nsvcd__bends *most) {
  const int both = m->fixed_moves;
  const nsvcd__v scale = nsvcd__v_set(m->scale);
  const nsvcd__v pivot = nsvcd__v_set(nsvcd__pivot_arm(m, &m->moving));
  const nsvcd__v bend = nsvcd__v_bend(scale, most->arc_bend + l, most->off + l);
  const nsvcd__v off = nsvcd__v_bend(pivot, most->arc_bend + l, most->origin_off + l);
  const nsvcd__v origin_bend = nsvcd__v_add(off, nsvcd__v_load(most->arc_origin + l));
  const nsvcd__v along = nsvcd__v_bend(scale, most->arc_along_axis + l, most->along_axis + l);
  const nsvcd__v origin_along =
      nsvcd__v_bend(pivot, most->arc_along_axis + l, most->origin_along_axis + l);
  const nsvcd__v across =
      nsvcd__v_bend(pivot, most->arc_bend + l, most->origin_off_heading + l);
  nsvcd__v_store(out->bend + l, bend);
  nsvcd__v_store(out->origin_bend + l, origin_bend);
  nsvcd__v_store(out->bend_along_axis + l, both ? bend : along);
  nsvcd__v_store(out->origin_along_axis + l, both ? origin_bend : origin_along);
  nsvcd__v_store(out->origin_off_heading + l, both ? origin_bend : across);

  const nsvcd__v3 start = nsvcd__v3_load(out->position, l);
  const nsvcd__v3 end = nsvcd__v3_add(start, nsvcd__v3_load(out->moved, l));
  const nsvcd__v extent = nsvcd__v_add(nsvcd__v3_norm(start), nsvcd__v3_norm(end));
  const nsvcd__v all = nsvcd__v_add(extent, nsvcd__v_plus(origin_bend, lengths));
  const nsvcd__v rounding = nsvcd__v_scale(all, NSVCD__ROUNDING);
  nsvcd__v_store(out->rounding + l, rounding);
  nsvcd__v_store(out->margin + l, nsvcd__v_add(rounding, origin_bend));
}

// Cuts 16 segments, of which the first `count` exist. begin: (17) ticks at which they begin, and
// the last one ends. lengths: the bodies' extents. Leaves the angle by which each turns in
// cut->most.turn.
static void nsvcd__cut_block(const nsvcd__motion *m, const uint32_t *begin, size_t count,
                             float lengths, nsvcd__segments *out, nsvcd__cut *cut) {
  uint32_t ticks[NSVCD__LANES];
  memset(&cut->most, 0, sizeof cut->most);
  memcpy(ticks, begin, sizeof ticks);
  nsvcd__cut_ends(m, begin, out, cut);
  for (int is_inside = 1; is_inside;) {
    is_inside = 0;
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      if (ticks[l] < begin[l + 1]) ticks[l] = nsvcd__next_keyframe(m, ticks[l]);
      if (ticks[l] > begin[l + 1]) ticks[l] = begin[l + 1];
      is_inside |= ticks[l] < begin[l + 1];
    }
    if (is_inside) nsvcd__cut_keyframe(m, begin, ticks, out, cut);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v_poses end = nsvcd__keyframes_load(m, &cut->end, l);
    const nsvcd__vquat seen = nsvcd__vquat_load(cut->end.seen + l, NSVCD__ENDS);
    nsvcd__cut_arc(m, &end, seen, l, out, cut);
    nsvcd__cut_deviations(m, lengths, l, out, &cut->most);
  }
  // the rest meet nothing
  for (size_t l = count; l < NSVCD__LANES; l++) out->margin[l] = NSVCD__NOWHERE;
}

// ---- all segments

// Cuts the chosen segments. lengths: the bodies' extents; clearance: spheres that come so near
// count as meeting.
static void nsvcd__cut_segments(const nsvcd__motion *m, float lengths, float clearance,
                                nsvcd__search *q) {
  uint32_t *begin = q->begin;
  float *turn = q->turn;
  // segments of no length fill the last block
  for (size_t s = q->segments; s % NSVCD__LANES; s++) begin[s + 1] = begin[s];
  turn[0] = 0;
  for (size_t s = 0; s < q->segments; s += NSVCD__LANES) {
    nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
    nsvcd__cut_block(m, begin + s, q->segments - s, lengths, block, q->cut);
    for (size_t l = 0; l < NSVCD__LANES; l++) {
      block->margin[l] += clearance;
      turn[s + l + 1] = turn[s + l] + q->cut->most.turn[l];
    }
  }
}

#ifndef NSVCD_NO_NETWORK
// Chooses and cuts the segments of all of a motion.
static NSVCD__NOINLINE void nsvcd__cut_motion(nsvcd__motion *m, float lengths,
                                              nsvcd__search *q) {
  nsvcd__choose_all(m, q);
  nsvcd__cut_segments(m, lengths, 0, q);
}
#endif

// --------------------------------------------------------------------------------- segments/chords
// In: a motion that has been cut, and spheres of the moving body. Out: the spheres on chords, in
// all segments or in one, and which of them meet spheres of the fixed body.
//
// Along its chord a sphere's radius grows by margin + bend |c|, c being its centre, so that it
// covers the sphere at its true pose all the time. So the test is conservative: spheres that meet
// at any time have chords that meet then, and if no chords do, the surfaces never meet, which is a
// proof. A group or a whole body is a sphere like any other: its sphere contains its members'.

NSVCD__INLINE nsvcd__v3 nsvcd__chords_start(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->start[0] + l);
}
NSVCD__INLINE nsvcd__v3 nsvcd__chords_travel(const nsvcd__chords *c, size_t l) {
  return nsvcd__v3_rows(c->travel[0] + l);
}
// Stores a slice of chords. FLT_MIN keeps a chord of no length finite.
static void nsvcd__chords_store(nsvcd__chords *c, size_t l, nsvcd__v3 start, nsvcd__v3 travel,
                                nsvcd__v radius) {
  const nsvcd__v least = nsvcd__v_set(1.2e-38f);
  const nsvcd__v square = nsvcd__v_max(nsvcd__v3_dot(travel, travel), least);
  nsvcd__v3_store(c->start, l, start);
  nsvcd__v3_store(c->travel, l, travel);
  nsvcd__v_store(c->inverse + l, nsvcd__v_div(nsvcd__v_set(-1), square));
  nsvcd__v_store(c->radius + l, radius);
}

// Chords of a sphere of the moving body in all segments, into q->group.
static void nsvcd__chords_in_all(nsvcd__search *q, nsvcd__sphere sphere) {
  sphere.radius *= q->scale;
  const nsvcd__v3 centre = nsvcd__v3_set(sphere.centre);
  const nsvcd__v length = nsvcd__v_set(nsvcd__f3_norm(sphere.centre));
  const nsvcd__v radius = nsvcd__v_set(sphere.radius);
  for (size_t s = 0; s < q->segments; s += NSVCD__LANES) {
    nsvcd__segments *b = &q->blocks[s / NSVCD__LANES];
    nsvcd__chords *out = &q->group[s / NSVCD__LANES];
    NSVCD__EACH_SLICE(l) {
      const nsvcd__vmat3 rotation = nsvcd__vmat3_load(b->rotation, l);
      const nsvcd__vmat3 turned = nsvcd__vmat3_load(b->turned, l);
      const nsvcd__v3 position = nsvcd__v3_load(b->position, l);
      const nsvcd__v3 moved = nsvcd__v3_load(b->moved, l);
      const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotation, centre, position);
      const nsvcd__v3 travel = nsvcd__vmat3_apply_add(turned, centre, moved);
      const nsvcd__v margin = nsvcd__v_load(b->margin + l);
      const nsvcd__v deviation = nsvcd__v_fma(nsvcd__v_load(b->bend + l), length, margin);
      nsvcd__chords_store(out, l, start, travel, nsvcd__v_add(deviation, radius));
    }
  }
}

// The 16 patches of a group.
static nsvcd__spheres nsvcd__members_of(const nsvcd_body *body, size_t g) {
  return nsvcd__spheres_from(nsvcd__body_patches(body), NSVCD__GROUP * g);
}

static void nsvcd__chords_of_group(nsvcd__search *q, size_t g) {
  nsvcd__chords_in_all(q, nsvcd__sphere_of(nsvcd__groups_of(q->moving), g));
}

// The deviation in segment s of points no farther than `extent` from the moving body's origin.
static float nsvcd__segment_deviation(const nsvcd__search *q, size_t s, float extent) {
  const nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  return block->margin[s % NSVCD__LANES] + block->bend[s % NSVCD__LANES] * extent;
}

// Chords of 16 spheres of the moving body in segment s. The patches in them are no farther than
// `extent` from the body's origin. Centres of spheres over patches may be farther, but on their
// chords the points of a body do not move relative to each other, so that the deviation of the
// patches is all to allow for.
static void nsvcd__chords_in_segment(const nsvcd__search *q, size_t s, nsvcd__spheres spheres,
                                     float extent, nsvcd__chords *out) {
  nsvcd__segments *b = &q->blocks[s / NSVCD__LANES];
  const size_t lane = s % NSVCD__LANES;
  const nsvcd__v deviation = nsvcd__v_set(nsvcd__segment_deviation(q, s, extent));
  const nsvcd__v scale = nsvcd__v_set(q->scale);
  const nsvcd__mat3 rotation = nsvcd__mat3_lane(b->rotation, lane);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(b->turned, lane);
  const nsvcd__v3 position = nsvcd__v3_set(nsvcd__lane_of(b->position, lane));
  const nsvcd__v3 moved = nsvcd__v3_set(nsvcd__lane_of(b->moved, lane));
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(spheres, l);
    const nsvcd__vmat3 rotations = nsvcd__vmat3_set(&rotation);
    const nsvcd__vmat3 turns = nsvcd__vmat3_set(&turned);
    const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotations, centre, position);
    const nsvcd__v3 travel = nsvcd__vmat3_apply_add(turns, centre, moved);
    const nsvcd__v radius = nsvcd__v_load(spheres.r + l);
    nsvcd__chords_store(out, l, start, travel, nsvcd__v_fma(scale, radius, deviation));
  }
}

// ---- tests

// The fraction of a chord at which it is nearest to a resting centre. d: from that to the start of
// the chord.
NSVCD__INLINE nsvcd__v nsvcd__nearest_at(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse) {
  return nsvcd__v_clamp(nsvcd__v_mul(nsvcd__v3_dot(d, travel), inverse), 0, 1);
}

// The square of a chord's distance from a resting centre. d: from that to the start of the chord.
NSVCD__INLINE nsvcd__v nsvcd__nearest2(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse) {
  const nsvcd__v tau = nsvcd__nearest_at(d, travel, inverse);
  const nsvcd__v3 nearest = nsvcd__v3_fma(tau, travel, d);
  return nsvcd__v3_dot(nearest, nearest);
}

// Lanes in which a chord comes within `radius` of a resting centre.
NSVCD__INLINE uint32_t nsvcd__comes_within(nsvcd__v3 d, nsvcd__v3 travel, nsvcd__v inverse,
                                           nsvcd__v radius) {
  return nsvcd__v_le(nsvcd__nearest2(d, travel, inverse), nsvcd__v_signed_square(radius));
}

// 16 moving spheres, or one in 16 segments, against one resting sphere.
NSVCD__INLINE uint32_t nsvcd__meet(const nsvcd__chords *c, nsvcd__sphere resting) {
  const nsvcd__v3 centre = nsvcd__v3_set(resting.centre);
  const nsvcd__v radius = nsvcd__v_set(resting.radius);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v sum = nsvcd__v_add(nsvcd__v_load(c->radius + l), radius);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    met |= nsvcd__comes_within(d, nsvcd__chords_travel(c, l), inverse, sum) << l;
  }
  return met;
}

// The sphere whose chords are q->group, in segment s, against 16 resting spheres.
NSVCD__INLINE uint32_t nsvcd__meet_members(const nsvcd__search *q, size_t s,
                                           nsvcd__spheres resting) {
  nsvcd__chords *c = &q->group[s / NSVCD__LANES];
  const size_t lane = s % NSVCD__LANES;
  const nsvcd__v3 start = nsvcd__v3_set(nsvcd__lane_of(c->start, lane));
  const nsvcd__v3 travel = nsvcd__v3_set(nsvcd__lane_of(c->travel, lane));
  const nsvcd__v inverse = nsvcd__v_set(c->inverse[lane]);
  const nsvcd__v own = nsvcd__v_set(c->radius[lane]);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_centres(resting, l));
    const nsvcd__v radius = nsvcd__v_add(own, nsvcd__v_load(resting.r + l));
    met |= nsvcd__comes_within(d, travel, inverse, radius) << l;
  }
  return met;
}

// The segments among `wanted` in which the sphere whose chords are q->group meets a resting
// one.
NSVCD__INLINE uint64_t nsvcd__meet_in(const nsvcd__search *q, uint64_t wanted,
                                      nsvcd__sphere resting) {
  uint64_t met = 0;
  for (size_t s = 0; s < NSVCD__MAX_SEGMENTS && wanted >> s; s += NSVCD__LANES) {
    if (wanted >> s & 0xffff)
      met |= (uint64_t)nsvcd__meet(&q->group[s / NSVCD__LANES], resting) << s;
  }
  return met & wanted;
}

// ------------------------------------------------------------------------------ segments/self_test
// In: nothing. Out: do these vectors compute as they should?

// The part of nsvcd_self_test that is about vectors: computes where a body's point (1, 0, 0) is at
// 16 ticks, while the body turns by 90 degrees about z from (4, 0, 0) to (-4, 0, 0), seen from a
// body at (1, 2, 3) whose x, y, z are y, z, x.
static int nsvcd__self_test_lanes(void) {
  // volatile, or the compiler would compute all this
  const volatile float half = 0.70710678f;
  const float turn = half;
  const nsvcd_pose path[2] = {{{4, 0, 0}, {0, 0, 0, 1}}, {{-4, 0, 0}, {0, 0, turn, turn}}};
  const nsvcd_pose rest = {{1, 2, 3}, {0.5f, 0.5f, 0.5f, 0.5f}};
  const nsvcd_mover moving = {NULL, path, 2, NULL, 0, {0}};
  const nsvcd_mover fixed = {NULL, &rest, 1, NULL, 0, {0}};
  nsvcd__chords chords;
  // A block, so that what comes after it shares its stack.
  {
    nsvcd__motion motion;
    nsvcd__keyframes keyframes;
    uint32_t ticks[NSVCD__LANES];
    for (uint32_t l = 0; l < NSVCD__LANES; l++) ticks[l] = l;
    nsvcd__motion_init(&moving, &fixed, &motion);
    nsvcd__motion_set_ticks(&motion, NSVCD__LANES);
    nsvcd__keyframes_read(&motion, ticks, NSVCD__LANES, &keyframes);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v_poses at = nsvcd__keyframes_load(&motion, &keyframes, l);
      const nsvcd__v_pose seen = nsvcd__v_seen(&motion, &at);
      const nsvcd__v3 arm = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
      const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
      const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotation, arm, seen.position);
      const nsvcd__v3 travel = nsvcd__v3_set(nsvcd__f3_of(0, 0, -0.5f));
      nsvcd__chords_store(&chords, l, start, travel, nsvcd__v_set(0.1f));
    }
  }
  int right = 1;
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const double angle = 1.5707963267948966 * (double)l / NSVCD__LANES;
    const double x = 3 - 0.5 * (double)l + cos(angle);
    right &= fabs((double)chords.start[0][l] - (sin(angle) - 2)) < 1e-4;
    right &= fabs((double)chords.start[1][l] + 3) < 1e-4;
    right &= fabs((double)chords.start[2][l] - x) < 1e-4;
  }
  // Only two of these chords come within 0.2 of the ninth point.
  nsvcd__sphere resting = {{half - 2, -3, half - 1}, 0.1f};
  right &= nsvcd__meet(&chords, resting) == 0x180;
  resting.centre.y += 1;
  right &= nsvcd__meet(&chords, resting) == 0;
#ifdef NSVCD_ONE_PATH
  // A product is rounded. If it were fused with the difference, 2^-24 would be left.
  const volatile float one_up = 1 + 1.0f / 4096;
  const volatile float square = 1 + 1.0f / 2048;
  const float factor = one_up;
  const float left = factor * factor - square;
  right &= !(left > 0);
#endif
  return right;
}

// ================================================================== search: which patches may meet

// ----------------------------------------------------------------------------------- search/planes
// In: 16 moving patches whose balls meet that of a resting one in a segment. Out: those that no
// plane separates from it all the time, by the hulls of their extremes.
//
// Planes are tried across the resting patch's normal, the moving patches', their difference, the
// lines between the centres, and first across the last few that separated other patches of the same
// query: one plane separates a table from what stands on it, whole groups at a time. Extremes go on
// chords, as centres do, and the deviation of points is allowed for. But extremes are not all of a
// patch, so this is no proof: if a greater recall is asked for, patches are inflated first.

#ifndef NSVCD_NO_NETWORK
// Begins the search of a motion.
static void nsvcd__plane_cache_begin(nsvcd__search *q, float inflate) {
  q->cache->found = q->cache->best = 0;
  q->cache->inflate = inflate;
  // inflated by their radii, patches meet wherever their balls do
  q->cache->balls_only = inflate >= 1;
  q->balls_met = 0;
}

static size_t nsvcd__planes_known(const nsvcd__search *q) {
  const size_t found = q->cache->found;
  return found < NSVCD__PLANES ? found : NSVCD__PLANES;
}

// ---- ranges

// Of the extremes (EXTREMES, 3, 16) of a slice of patches, along u. step: of the extremes, in the
// body's units; height: of the patches' centres.
NSVCD__INLINE nsvcd__v_range nsvcd__extremes_along(const int8_t *extremes, nsvcd__v step,
                                                   nsvcd__v3 u, nsvcd__v height) {
  nsvcd__v low = nsvcd__v_set(1e30f);
  nsvcd__v high = nsvcd__v_set(-1e30f);
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__LANES) {
    const nsvcd__v3 x = nsvcd__v3_load_int8(extremes, NSVCD__LANES);
    const nsvcd__v along = nsvcd__v3_dot(x, u);
    low = nsvcd__v_min(low, along);
    high = nsvcd__v_max(high, along);
  }
  const nsvcd__v_range out = {nsvcd__v_fma(step, low, height),
                              nsvcd__v_fma(step, high, height)};
  return out;
}

// The same at both ends of a segment, between which the normal turns in the body's frame.
NSVCD__INLINE nsvcd__v_range nsvcd__moving_range(const int8_t *extremes, nsvcd__v step,
                                                 nsvcd__v3 u, nsvcd__v3 u_end, nsvcd__v height,
                                                 nsvcd__v height_end) {
  const nsvcd__v_range a = nsvcd__extremes_along(extremes, step, u, height);
  const nsvcd__v_range b = nsvcd__extremes_along(extremes, step, u_end, height_end);
  const nsvcd__v_range out = {nsvcd__v_min(a.low, b.low), nsvcd__v_max(a.high, b.high)};
  return out;
}

// Stores a range that is wider by `off` on both sides.
static void nsvcd__ranges_store(nsvcd__v_range range, nsvcd__v off, size_t l,
                                nsvcd__ranges *out) {
  nsvcd__v_store(out->low + l, nsvcd__v_sub(range.low, off));
  nsvcd__v_store(out->high + l, nsvcd__v_add(range.high, off));
}

// Fills in the ranges of group h of the fixed body along plane n.
static void nsvcd__know_resting(const nsvcd__search *q, size_t h, size_t n) {
  nsvcd__plane_cache *cache = q->cache;
  if (cache->resting_known >> n & 1) return;
  cache->resting_known |= 1u << n;
  const nsvcd__spheres patches = nsvcd__members_of(q->fixed, h);
  const int8_t *extremes = nsvcd__group_extremes(q->fixed, h);
  const nsvcd__v3 u = nsvcd__v3_set(cache->planes[n]);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v step = nsvcd__v_scale(nsvcd__v_load(patches.r + l), 1.0f / 127);
    const nsvcd__v height = nsvcd__v3_dot(u, nsvcd__v3_centres(patches, l));
    const nsvcd__v_range range = nsvcd__extremes_along(extremes + l, step, u, height);
    const nsvcd__v inflate = nsvcd__v_scale(step, 127 * cache->inflate);
    nsvcd__ranges_store(range, inflate, l, &cache->resting[n]);
  }
}

// Fills in the ranges of moving group g in segment s along plane n, deviation included.
static void nsvcd__know_moving(const nsvcd__search *q, size_t g, size_t s, size_t n) {
  nsvcd__plane_cache *cache = q->cache;
  if (cache->moving_known >> n & 1) return;
  cache->moving_known |= 1u << n;
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const nsvcd__chords *c = &q->members[s];
  const nsvcd__f3 normal = cache->planes[n];
  const nsvcd__mat3 rotation = nsvcd__mat3_lane(block->rotation, s % NSVCD__LANES);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, s % NSVCD__LANES);
  const nsvcd__f3 start = nsvcd__mat3_apply_transpose(&rotation, normal);
  const nsvcd__f3 change = nsvcd__mat3_apply_transpose(&turned, normal);
  const nsvcd__v3 u_start = nsvcd__v3_set(start);
  const nsvcd__v3 u_end = nsvcd__v3_set(nsvcd__f3_add(start, change));
  const nsvcd__v3 u = nsvcd__v3_set(normal);
  const float *radii = nsvcd__body_r(q->moving) + NSVCD__GROUP * g;
  const int8_t *extremes = nsvcd__group_extremes(q->moving, g);
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v step = nsvcd__v_scale(nsvcd__v_load(radii + l), 1.0f / 127);
    const nsvcd__v height = nsvcd__v3_dot(u, nsvcd__chords_start(c, l));
    const nsvcd__v height_end = nsvcd__v3_dot_add(u, nsvcd__chords_travel(c, l), height);
    const nsvcd__v_range range =
        nsvcd__moving_range(extremes + l, step, u_start, u_end, height, height_end);
    const nsvcd__v inflate = nsvcd__v_scale(step, 127 * q->scale * cache->inflate);
    nsvcd__ranges_store(range, nsvcd__v_plus(inflate, cache->deviation), l, &cache->moving[n]);
  }
}

// ---- planes that separated others

// The least of all lanes, times a sign.
static float nsvcd__least_lane(const float *lanes, float sign) {
  nsvcd__v least = nsvcd__v_set(1e30f);
  NSVCD__EACH_SLICE(l)
  least = nsvcd__v_min(least, nsvcd__v_scale(nsvcd__v_load(lanes + l), sign));
  return nsvcd__v_least(least);
}

// Lanes whose ranges do not overlap low to high.
static uint32_t nsvcd__lanes_outside(const nsvcd__ranges *ranges, float low, float high) {
  const nsvcd__v lowest = nsvcd__v_set(low);
  const nsvcd__v highest = nsvcd__v_set(high);
  uint32_t outside = 0;
  NSVCD__EACH_SLICE(l) {
    outside |= nsvcd__v_lt(highest, nsvcd__v_load(ranges->low + l)) << l;
    outside |= nsvcd__v_lt(nsvcd__v_load(ranges->high + l), lowest) << l;
  }
  return outside;
}

// Of the segments `wanted`, those in which the plane that separated last does not separate the
// moving group's ball, whose chords are q->group, from all of group h of the fixed body.
static uint64_t nsvcd__segments_left(const nsvcd__search *q, size_t h, uint64_t wanted) {
  nsvcd__plane_cache *cache = q->cache;
  const size_t n = cache->best;
  uint64_t separated = 0;
  if (n >= nsvcd__planes_known(q)) return wanted;
  nsvcd__know_resting(q, h, n);
  const nsvcd__ranges *resting = &cache->resting[n];
  const nsvcd__v below = nsvcd__v_set(nsvcd__least_lane(resting->low, 1));
  const nsvcd__v above = nsvcd__v_set(-nsvcd__least_lane(resting->high, -1));
  const nsvcd__v3 u = nsvcd__v3_set(cache->planes[n]);
  for (size_t s = 0; s < q->segments; s += NSVCD__LANES) {
    const nsvcd__chords *c = &q->group[s / NSVCD__LANES];
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v start = nsvcd__v3_dot(u, nsvcd__chords_start(c, l));
      const nsvcd__v end = nsvcd__v3_dot_add(u, nsvcd__chords_travel(c, l), start);
      const nsvcd__v radius = nsvcd__v_scale(nsvcd__v_load(c->radius + l), 1 + cache->inflate);
      const nsvcd__v low = nsvcd__v_sub(nsvcd__v_min(start, end), radius);
      const nsvcd__v high = nsvcd__v_add(nsvcd__v_max(start, end), radius);
      const uint32_t here = nsvcd__v_lt(above, low) | nsvcd__v_lt(high, below);
      separated |= (uint64_t)here << (s + l);
    }
  }
  return wanted & ~separated;
}

// Of the members `bits` of group h of the fixed body, those that the same plane does not separate
// from all of moving group g in segment s.
static uint32_t nsvcd__members_left(const nsvcd__search *q, size_t g, size_t s, size_t h,
                                    uint32_t bits) {
  const nsvcd__plane_cache *cache = q->cache;
  const size_t n = cache->best;
  if (n >= nsvcd__planes_known(q)) return bits;
  nsvcd__know_resting(q, h, n);
  nsvcd__know_moving(q, g, s, n);
  const float low = nsvcd__least_lane(cache->moving[n].low, 1);
  const float high = -nsvcd__least_lane(cache->moving[n].high, -1);
  return bits & ~nsvcd__lanes_outside(&cache->resting[n], low, high);
}

// Of the lanes `met` of moving group g in segment s, those that no remembered plane separates from
// member k of group h of the fixed body.
static uint32_t nsvcd__lanes_left_by_known(nsvcd__search *q, size_t g, size_t s, size_t h,
                                           size_t k, uint32_t met) {
  nsvcd__plane_cache *cache = q->cache;
  const size_t planes = nsvcd__planes_known(q);
  for (size_t m = 0; m < planes && met; m++) {
    const size_t n = (cache->best + m) % planes;  // the one that separated last, first
    nsvcd__know_resting(q, h, n);
    nsvcd__know_moving(q, g, s, n);
    const nsvcd__ranges *resting = &cache->resting[n];
    const uint32_t separated =
        nsvcd__lanes_outside(&cache->moving[n], resting->low[k], resting->high[k]);
    if (met & separated) cache->best = (uint32_t)n;
    met &= ~separated;
  }
  return met;
}

// ---- planes of their own

// A resting patch: its extremes are relative to its centre, metres.
typedef struct nsvcd__resting {
  nsvcd__f3 centre;
  float radius;
  nsvcd__f3 extremes[NSVCD__EXTREMES];
  nsvcd__f3 normal;  // the mean
} nsvcd__resting;

static nsvcd__resting nsvcd__resting_of(const nsvcd_body *body, size_t j) {
  const int8_t *extremes = nsvcd__group_extremes(body, j / NSVCD__GROUP) + j % NSVCD__GROUP;
  nsvcd__resting out;
  const nsvcd__sphere ball = nsvcd__sphere_of(nsvcd__body_patches(body), j);
  const float step = ball.radius / 127;
  out.centre = ball.centre;
  out.radius = ball.radius;
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__GROUP) {
    const nsvcd__f3 extreme =
        nsvcd__f3_of(extremes[0], extremes[NSVCD__GROUP], extremes[2 * NSVCD__GROUP]);
    out.extremes[k] = nsvcd__f3_scale(extreme, step);
  }
  const nsvcd__f3 area = nsvcd__f3_get(nsvcd__body_areas(body) + j, body->padded);
  const float length = nsvcd__f3_norm(area);
  out.normal = nsvcd__f3_scale(area, length > 0 ? 1 / length : 0);
  return out;
}

// A slice of moving patches, over a segment.
typedef struct nsvcd__passing {
  const int8_t *extremes;   // (EXTREMES, 3, 16) and lane l, of the moving group
  nsvcd__v step;            // of the extremes, in the body's units
  nsvcd__v3 from, travel;   // from the resting centre to the moving one; and along the chord
  nsvcd__vmat3 start, end;  // rotations, times the scale
  nsvcd__v deviation;       // of points, and what patches are inflated by
} nsvcd__passing;

// Lanes in which a plane across u separates both, on either side.
NSVCD__INLINE uint32_t nsvcd__separated_along(const nsvcd__passing *p,
                                              const nsvcd__resting *rest, nsvcd__v3 u) {
  const nsvcd__v3 u_start = nsvcd__vmat3_apply_transpose(p->start, u);
  const nsvcd__v3 u_end = nsvcd__vmat3_apply_transpose(p->end, u);
  const nsvcd__v height = nsvcd__v3_dot(u, p->from);
  const nsvcd__v height_end = nsvcd__v3_dot_add(u, p->travel, height);
  const nsvcd__v_range moving =
      nsvcd__moving_range(p->extremes, p->step, u_start, u_end, height, height_end);
  nsvcd__v below = nsvcd__v_set(1e30f);
  nsvcd__v above = nsvcd__v_set(-1e30f);
  for (size_t k = 0; k < NSVCD__EXTREMES; k++) {
    const nsvcd__v along = nsvcd__v3_dot(nsvcd__v3_set(rest->extremes[k]), u);
    below = nsvcd__v_min(below, along);
    above = nsvcd__v_max(above, along);
  }
  return nsvcd__v_lt(above, nsvcd__v_sub(moving.low, p->deviation)) |
         nsvcd__v_lt(nsvcd__v_add(moving.high, p->deviation), below);
}

enum {
  NSVCD__ALONG_RESTING,  // normal
  NSVCD__ALONG_MOVING,   // normals
  NSVCD__ALONG_LINE,     // between the centres
  NSVCD__ALONG_BOTH,     // normals, from one to the other
  NSVCD__DIRECTIONS
};

// Of the lanes `met` of moving group g in segment s, those that no plane of their own separates
// from patch j of the fixed body. A plane that does replaces the oldest that is remembered.
static NSVCD__NOINLINE uint32_t nsvcd__lanes_left_by_own(nsvcd__search *q, size_t g, size_t s,
                                                         size_t j, uint32_t met) {
  nsvcd__plane_cache *cache = q->cache;
  const nsvcd__resting rest = nsvcd__resting_of(q->fixed, j);
  const int8_t *extremes = nsvcd__group_extremes(q->moving, g);
  const nsvcd_body *moving = q->moving;
  const nsvcd__chords *c = &q->members[s];
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, s % NSVCD__LANES);
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, s % NSVCD__LANES);
  const nsvcd__mat3 end = nsvcd__mat3_mix(1, &start, 1, &turned);
  nsvcd__passing p;
  p.start = nsvcd__vmat3_set(&start);
  p.end = nsvcd__vmat3_set(&end);
  for (size_t n = 0; n < NSVCD__DIRECTIONS && met; n++) {
    nsvcd__f3 plane = {0, 0, 0};
    uint32_t separated = 0;
    NSVCD__EACH_SLICE(l) {
      const size_t i = NSVCD__GROUP * g + l;
      const uint32_t lanes = met >> l & NSVCD__SLICE_MASK;
      if (!lanes) continue;
      p.extremes = extremes + l;
      p.step = nsvcd__v_scale(nsvcd__v_load(nsvcd__body_r(moving) + i), 1.0f / 127);
      p.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(rest.centre));
      p.travel = nsvcd__chords_travel(c, l);
      const nsvcd__v inflate = nsvcd__v_scale(p.step, 127 * q->scale * cache->inflate);
      p.deviation = nsvcd__v_plus(inflate, cache->deviation + rest.radius * cache->inflate);
      nsvcd__v3 u = nsvcd__v3_set(rest.normal);
      if (n == NSVCD__ALONG_LINE) {
        u = nsvcd__v3_unit(nsvcd__v3_fma(nsvcd__v_set(0.5f), p.travel, p.from));
      } else if (n != NSVCD__ALONG_RESTING) {
        const float *areas = nsvcd__body_areas(moving) + i;
        const nsvcd__v3 area = nsvcd__v3_get(areas, moving->padded);
        const nsvcd__v3 first = nsvcd__vmat3_apply(p.start, area);
        const nsvcd__v3 last = nsvcd__vmat3_apply(p.end, area);
        const nsvcd__v3 halfway = nsvcd__v3_unit(nsvcd__v3_add(first, last));
        u = n == NSVCD__ALONG_MOVING ? halfway : nsvcd__v3_unit(nsvcd__v3_sub(u, halfway));
      }
      const uint32_t here = nsvcd__separated_along(&p, &rest, u) & lanes;
      if (here && !separated) {
        float rows[3 * NSVCD__SLICE];
        nsvcd__v3_put(u, rows, NSVCD__SLICE);
        plane = nsvcd__f3_get(rows + nsvcd__low_bit(here), NSVCD__SLICE);
      }
      separated |= here << l;
    }
    met &= ~separated;
    if (!separated) continue;
    const size_t oldest = cache->found++ % NSVCD__PLANES;
    cache->planes[oldest] = plane;
    cache->moving_known &= ~(1u << oldest);
    cache->resting_known &= ~(1u << oldest);
  }
  return met;
}

// The lanes of moving group g whose balls meet member k of group h of the fixed body in segment s,
// and that no plane separates from it. before: those that met it in the segment before: planes of
// their own would rarely separate them now.
static uint32_t nsvcd__members_meet(nsvcd__search *q, size_t g, size_t s, size_t h, size_t k,
                                    uint32_t before) {
  const size_t j = NSVCD__GROUP * h + k;
  const nsvcd__sphere ball = nsvcd__sphere_of(nsvcd__body_patches(q->fixed), j);
  uint32_t met = nsvcd__meet(&q->members[s], ball);
  q->balls_met |= met != 0;
  if (q->cache->balls_only) return met;
  if (met) met = nsvcd__lanes_left_by_known(q, g, s, h, k, met);
  const uint32_t fresh = met & ~before;
  if (!fresh) return met;
  return (met & before) | nsvcd__lanes_left_by_own(q, g, s, j, fresh);
}
#endif  // NSVCD_NO_NETWORK

// -------------------------------------------------------------------------------- search/intervals
// In: the chords of patches, and the patches of the other body that they meet. Out: candidates: the
// pairs, and when their balls meet.

#ifndef NSVCD_NO_NETWORK
// radians, 45 degrees: an interval is cut before it turns more, for the decoder's twist
#define NSVCD__INTERVAL_TURN 0.785f
#define NSVCD__NO_SCORE (-1e30f)

static void nsvcd__candidates_start(nsvcd__candidates *kept, nsvcd__candidate *items,
                                    size_t limit) {
  const nsvcd__candidates none = {items, limit, 0, 0};
  *kept = none;
}

// A total order, so that ties do not depend on the order in which intervals were found.
static int nsvcd__is_shallower(const nsvcd__candidate *a, const nsvcd__candidate *b) {
  if (a->depth < b->depth || a->depth > b->depth) return a->depth < b->depth;
  if (a->moving != b->moving) return a->moving > b->moving;
  if (a->fixed != b->fixed) return a->fixed > b->fixed;
  return a->t_enter > b->t_enter;
}

// Counts an interval, and keeps it if there is room, or in place of the shallowest.
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

// Contact intervals of a slice that are still growing, one per lane. Parameters along a segment's
// line are 0 at its start and 1 at its end: at `nearest` the line is nearest to the other centre,
// and the spheres overlap from `nearest` - h to `nearest` + h; half2 is the square of h.
typedef struct nsvcd__intervals {
  uint32_t open;   // lanes
  size_t last;     // the segment that all of them reach
  nsvcd__v fresh;  // 1 in lanes without an interval, else 0
  nsvcd__v first, first_nearest, first_half2, last_nearest, last_half2;
  nsvcd__v square, least_segment, least;  // the least distance, squared, and where it is
} nsvcd__intervals;

// The time at a fraction of segment s: at 1 that of its end, to the bit.
static float nsvcd__time_in_segment(const nsvcd__search *q, size_t s, float fraction) {
  const float start = q->time[s];
  const float end = q->time[s + 1];
  return fraction < 1 ? start + fraction * (end - start) : end;
}

// Ends the intervals of `lanes`, and adds them to the candidates. The slice's first lane is patch i
// of the moving body; j: the patch of the fixed one.
static void nsvcd__intervals_close(nsvcd__intervals *intervals, uint32_t lanes,
                                   const nsvcd__search *q, size_t i, size_t j,
                                   nsvcd__candidates *kept) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v own = nsvcd__v_load(nsvcd__body_r(q->moving) + i);
  const nsvcd__v other = nsvcd__v_set(nsvcd__body_r(q->fixed)[j]);
  const nsvcd__v scaled = nsvcd__v_scale(own, q->scale);
  const nsvcd__v radii = nsvcd__v_max(nsvcd__v_add(scaled, other), nsvcd__v_set(1e-30f));
  intervals->open &= ~lanes;
  // Most are shallower than all of a full heap, and are only counted.
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
  const nsvcd__v fraction = nsvcd__v_div(nsvcd__v_sqrt(intervals->square), radii);
  nsvcd__v_store(first, intervals->first);
  nsvcd__v_store(least_segment, intervals->least_segment);
  nsvcd__v_store(enter, nsvcd__v_max(nsvcd__v_sub(intervals->first_nearest, before), zero));
  nsvcd__v_store(leave, nsvcd__v_min(nsvcd__v_add(intervals->last_nearest, after), one));
  nsvcd__v_store(least, intervals->least);
  nsvcd__v_store(depth, nsvcd__v_sub(one, fraction));
  for (; lanes; lanes &= lanes - 1) {
    const size_t l = nsvcd__low_bit(lanes);
    nsvcd__candidate candidate;
    candidate.moving = (uint16_t)(i + l);
    candidate.fixed = (uint16_t)j;
    candidate.t_enter = nsvcd__time_in_segment(q, (size_t)first[l], enter[l]);
    candidate.t_exit = nsvcd__time_in_segment(q, intervals->last, leave[l]);
    candidate.t_least = nsvcd__time_in_segment(q, (size_t)least_segment[l], least[l]);
    candidate.depth = depth[l];
    candidate.score = NSVCD__NO_SCORE;
    candidate.apart = 0;
    // Rounding must not put the nearest time outside.
    if (candidate.t_enter > candidate.t_least) candidate.t_enter = candidate.t_least;
    if (candidate.t_exit < candidate.t_least) candidate.t_exit = candidate.t_least;
    nsvcd__candidates_add(kept, &candidate);
  }
}

// The segments at whose start all contact intervals of a group's members are cut: because the
// oldest of them would turn too far, or the segment before is not `wanted`. met: (segments). For
// all 16 beforehand, so that machines with narrower slices find the same intervals.
static uint64_t nsvcd__interval_cuts(const nsvcd__search *q, const uint16_t *met,
                                     uint64_t wanted) {
  uint64_t cuts = wanted & ~(wanted << 1);
  uint32_t open = 0;
  size_t oldest = 0;
  if (!(q->turn[q->segments] > NSVCD__INTERVAL_TURN)) return cuts;
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    if (open && q->turn[s + 1] - q->turn[oldest] > NSVCD__INTERVAL_TURN)
      cuts |= (uint64_t)1 << s;
    if (cuts >> s & 1) open = 0;
    open &= met[s];
    if (!open) oldest = s;
    open = met[s];
  }
  return cuts;
}

// Contact intervals of a slice of moving patches, from patch i on, with patch j of the fixed body,
// in the segments `wanted`, in which the lanes all_met[s] of the group meet it. cuts:
// nsvcd__interval_cuts.
static NSVCD__NOINLINE void nsvcd__slice_against_patch(const nsvcd__search *q, size_t i,
                                                       size_t j, uint64_t wanted,
                                                       const uint16_t *all_met, uint64_t cuts,
                                                       nsvcd__candidates *kept) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(q->fixed), j);
  const nsvcd__v3 centre = nsvcd__v3_set(patch.centre);
  const size_t l = i % NSVCD__GROUP;
  nsvcd__intervals at = {0, 0, one, zero, zero, zero, zero, zero, zero, zero, zero};
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    const nsvcd__chords *c = &q->members[s];
    const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), centre);
    const nsvcd__v inverse = nsvcd__v_load(c->inverse + l);
    const nsvcd__v radius = nsvcd__v_plus(nsvcd__v_load(c->radius + l), patch.radius);
    // the square of the sum of radii; where the line is nearest, and where the chord is
    const nsvcd__v limit = nsvcd__v_signed_square(radius);
    const nsvcd__v nearest = nsvcd__v_mul(nsvcd__v3_dot(d, travel), inverse);
    const nsvcd__v tau = nsvcd__v_clamp(nearest, 0, 1);
    const nsvcd__v3 chord = nsvcd__v3_fma(tau, travel, d);
    const nsvcd__v square = nsvcd__v3_dot(chord, chord);
    const uint32_t met = all_met[s] >> l & NSVCD__SLICE_MASK;
    const int is_cut = (int)(cuts >> s & 1);
    const uint32_t ended = is_cut ? at.open : at.open & ~met;
    if (ended) nsvcd__intervals_close(&at, ended, q, i, j, kept);
    if (is_cut || !met) at.fresh = one;
    if (!met) continue;

    // Intervals go on, or begin. |d + tau travel| = radius, solved from the line's nearest point
    // outwards: b^2 - ac would cancel on long chords.
    const nsvcd__v segment = nsvcd__v_set((float)s);
    const nsvcd__v3 line = nsvcd__v3_fma(nearest, travel, d);
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
    if (met != nsvcd__v_le(square, limit)) {
      float fresh[NSVCD__SLICE];
      for (size_t k = 0; k < NSVCD__SLICE; k++) fresh[k] = met >> k & 1 ? 0.0f : 1.0f;
      at.fresh = nsvcd__v_load(fresh);
    }
    at.open = met;
    at.last = s;
  }
  if (at.open) nsvcd__intervals_close(&at, at.open, q, i, j, kept);
}
#endif  // NSVCD_NO_NETWORK

// ----------------------------------------------------------------------------------- search/search
// In: two bodies, and a motion that has been cut. Out: each pair of patches whose spheres meet, and
// the segments in which they do, group by group.
//
// The hierarchy: body against body; boxes of groups against groups; group against group; group
// against 16 spheres; 16 spheres against a sphere. But for the boxes every step is the same test,
// moving spheres on chords against resting ones; lanes are segments, or members of a group. A step
// of the search is a pair of groups. Moving groups that meet most come first, and of each the group
// that it meets longest: a deep collision is then found before the rest is searched.
//
// A *tile* is up to 32 groups of one body and up to 32 of the other, which are searched together.
// Bodies of up to 512 patches are one tile. Of larger ones, a traversal of the levels of spheres
// above the groups finds those that the other body comes near, and they are searched tile after
// tile: each moving tile against all tiles of the fixed body.

// Boxes that contain 16 groups of the moving tile, from `first` on, in those segments `wanted` in
// which they meet the fixed body's sphere, in its axes and units. Empty, low above high, for groups
// that never do.
static void nsvcd__boxes_of_groups(const nsvcd__search *q, size_t first, uint64_t wanted,
                                   nsvcd__boxes *out) {
  const nsvcd__spheres groups = nsvcd__spheres_from(q->moving_tile.spheres, first);
  const nsvcd__sphere fixed = nsvcd__body_sphere(q->fixed);
  nsvcd__chords *c = nsvcd__spare_chords(q);
  for (size_t n = 0; n < 3 * NSVCD__LANES; n++) {
    out->low[n / NSVCD__LANES][n % NSVCD__LANES] = -NSVCD__NOWHERE;
    out->high[n / NSVCD__LANES][n % NSVCD__LANES] = NSVCD__NOWHERE;
  }
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    nsvcd__chords_in_segment(q, s, groups, q->moving->extent, c);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v nowhere = nsvcd__v_set(NSVCD__NOWHERE);
      const nsvcd__v3 start = nsvcd__chords_start(c, l);
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d = nsvcd__v3_sub(start, nsvcd__v3_set(fixed.centre));
      const nsvcd__v radius = nsvcd__v_load(c->radius + l);
      const nsvcd__v sum = nsvcd__v_plus(radius, fixed.radius);
      const nsvcd__v square = nsvcd__nearest2(d, travel, nsvcd__v_load(c->inverse + l));
      const nsvcd__v nearby =
          nsvcd__v_pick(square, nsvcd__v_signed_square(sum), radius, nowhere);
      const nsvcd__v3 end = nsvcd__v3_add(start, travel);
      const nsvcd__v3 around = nsvcd__v3_of(nearby, nearby, nearby);
      const nsvcd__v3 low = nsvcd__v3_sub(nsvcd__v3_min(start, end), around);
      const nsvcd__v3 high = nsvcd__v3_add(nsvcd__v3_max(start, end), around);
      nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_load(out->low, l), low));
      nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_load(out->high, l), high));
    }
  }
}

// Which of 16 spheres overlap a box?
static uint32_t nsvcd__spheres_at_box(nsvcd__box box, nsvcd__spheres all) {
  const nsvcd__v3 none = nsvcd__v3_set(nsvcd__f3_of(0, 0, 0));
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_centres(all, l);
    const nsvcd__v3 below = nsvcd__v3_sub(nsvcd__v3_set(box.low), centre);
    const nsvcd__v3 above = nsvcd__v3_sub(centre, nsvcd__v3_set(box.high));
    const nsvcd__v3 d = nsvcd__v3_max(nsvcd__v3_max(below, above), none);
    const nsvcd__v radius = nsvcd__v_load(all.r + l);
    met |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(radius)) << l;
  }
  return met;
}

static uint64_t nsvcd__all_segments(const nsvcd__search *q) {
  return ~(uint64_t)0 >> (NSVCD__MAX_SEGMENTS - q->segments);
}

// Orders the steps of the search of both tiles: the groups of the moving tile that meet some of the
// fixed tile, those first that meet most of them in most segments. nsvcd__nearby says which, and
// in which segments. wanted: segments in which the bodies' spheres meet.
static void nsvcd__search_tile(nsvcd__search *q, uint64_t wanted) {
  uint16_t meetings[NSVCD__TILE_SLOTS];
  const nsvcd__tile *tile = &q->fixed_tile;
  nsvcd__boxes *boxes = nsvcd__spare_boxes(q);
  q->steps = q->step = 0;
  q->waiting = 0;
  for (size_t g = 0; g < q->moving_tile.count; g++) {
    const size_t l = g % NSVCD__LANES;
    if (l == 0) nsvcd__boxes_of_groups(q, g, wanted, boxes);
    const nsvcd__box box = {nsvcd__lane_of(boxes->low, l), nsvcd__lane_of(boxes->high, l)};
    uint32_t groups = 0;
    for (size_t first = 0; first < tile->count; first += NSVCD__LANES)
      groups |= nsvcd__spheres_at_box(box, nsvcd__spheres_from(tile->spheres, first)) << first;
    if (!groups) continue;
    uint64_t *nearby = nsvcd__nearby(q, g);
    size_t count = 0;
    nsvcd__chords_of_group(q, q->moving_tile.groups[g]);
    memset(nearby, 0, tile->count * sizeof *nearby);
    for (; groups; groups &= groups - 1) {
      const size_t h = nsvcd__low_bit(groups);
      const nsvcd__sphere resting = nsvcd__sphere_of(tile->spheres, h);
      nearby[h] = nsvcd__meet_in(q, nsvcd__all_segments(q), resting);
      count += nsvcd__bit_count(nearby[h]);
    }
    if (!count) continue;
    size_t at = q->steps;
    for (; at > 0 && meetings[at - 1] < count; at--) {
      meetings[at] = meetings[at - 1];
      q->order[at] = q->order[at - 1];
    }
    meetings[at] = (uint16_t)count;
    q->order[at] = (uint16_t)g;
    q->steps++;
  }
}

// Fills a tile with the next groups that a traversal finds.
static void nsvcd__tile_fill(nsvcd__tile *tile, nsvcd__traversal *traversal) {
  size_t g;
  tile->spheres = nsvcd__spheres_of(tile->collected, NSVCD__TILE_SLOTS);
  for (size_t n = 0; n < 4 * NSVCD__TILE_SLOTS; n++)
    tile->collected[n] = n < 3 * NSVCD__TILE_SLOTS ? 0 : NSVCD__NOWHERE;
  tile->count = 0;
  while (tile->count < NSVCD__TILE && nsvcd__traversal_next(traversal, &g)) {
    const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(traversal->body), g);
    nsvcd__sphere_store(group, tile->collected, NSVCD__TILE_SLOTS, tile->count);
    tile->groups[tile->count++] = (uint16_t)g;
  }
}

// Fills a tile with all groups of a body.
static void nsvcd__tile_fill_all(nsvcd__tile *tile, const nsvcd_body *body) {
  tile->count = nsvcd__body_groups(body);
  for (size_t g = 0; g < tile->count; g++) tile->groups[g] = (uint16_t)g;
  tile->spheres = nsvcd__groups_of(body);
}

// ---- filters of a traversal, which are given the search

// All spheres but padding.
static uint32_t nsvcd__exists(const void *what, nsvcd__spheres all) {
  uint32_t exists = 0;
  (void)what;
  NSVCD__EACH_SLICE(l) exists |= nsvcd__v_le(nsvcd__v_set(0), nsvcd__v_load(all.r + l)) << l;
  return exists;
}

// Spheres of the moving body that meet that of the fixed one.
static uint32_t nsvcd__comes_near(const void *what, nsvcd__spheres all) {
  const nsvcd__search *q = (const nsvcd__search *)what;
  const nsvcd__sphere fixed = nsvcd__body_sphere(q->fixed);
  nsvcd__chords *chords = nsvcd__spare_chords(q);
  uint32_t met = 0;
  for (uint64_t wanted = q->near_segments; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    nsvcd__chords_in_segment(q, s, all, q->moving->extent, chords);
    met |= nsvcd__meet(chords, fixed);
  }
  return met;
}

// Spheres of the fixed body that meet that of the moving tile, whose chords are q->group.
static uint32_t nsvcd__is_approached(const void *what, nsvcd__spheres all) {
  const nsvcd__search *q = (const nsvcd__search *)what;
  const uint32_t nearby = nsvcd__spheres_at_box(q->near_box, all);
  uint32_t met = 0;
  for (uint64_t wanted = q->near_segments; wanted && nearby & ~met; wanted &= wanted - 1) {
    met |= nearby & nsvcd__meet_members(q, nsvcd__low_bit(wanted), all);
  }
  return met;
}

// Chords of the sphere over all groups of the moving tile, into q->group.
static void nsvcd__chords_of_tile(nsvcd__search *q) {
  const nsvcd__tile *tile = &q->moving_tile;
  nsvcd__sphere sphere = nsvcd__body_sphere(q->moving);
  if (nsvcd__is_large(q->moving)) sphere = nsvcd__cover_spheres(tile->spheres, tile->count);
  nsvcd__chords_in_all(q, sphere);
}

// Finds the next moving tile, an empty one if there is none, and starts a traversal of the fixed
// body's groups that come near it.
static void nsvcd__search_moving_tile(nsvcd__search *q) {
  nsvcd__box box = {{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
  nsvcd__tile_fill(&q->moving_tile, &q->moving_traversal);
  if (q->moving_tile.count == 0) return;
  nsvcd__chords_of_tile(q);
  for (uint64_t left = q->near_segments; left; left &= left - 1) {
    const size_t s = nsvcd__low_bit(left);
    nsvcd__chords *c = &q->group[s / NSVCD__LANES];
    const size_t l = s % NSVCD__LANES;
    const nsvcd__f3 start = nsvcd__lane_of(c->start, l);
    const nsvcd__f3 end = nsvcd__f3_add(start, nsvcd__lane_of(c->travel, l));
    const nsvcd__f3 around = nsvcd__f3_of(c->radius[l], c->radius[l], c->radius[l]);
    const nsvcd__f3 low = nsvcd__f3_sub(nsvcd__f3_min(start, end), around);
    const nsvcd__f3 high = nsvcd__f3_add(nsvcd__f3_max(start, end), around);
    box.low = nsvcd__f3_min(box.low, low);
    box.high = nsvcd__f3_max(box.high, high);
  }
  q->near_box = box;
  nsvcd__traversal_begin(&q->fixed_traversal, q->fixed, nsvcd__is_approached, q);
}

// Goes on to the next pair of tiles that has a step. 0 if there is none.
static int nsvcd__search_next_tile(nsvcd__search *q) {
  if (!nsvcd__is_tiled(q->moving, q->fixed)) return 0;
  while (q->moving_tile.count > 0) {
    nsvcd__chords_of_tile(q);
    nsvcd__tile_fill(&q->fixed_tile, &q->fixed_traversal);
    if (q->fixed_tile.count == 0) {
      nsvcd__search_moving_tile(q);
      continue;
    }
    nsvcd__search_tile(q, q->near_segments);
    if (q->steps > 0) return 1;
  }
  return 0;
}

// Starts the search of some segments. Returns 0 if the groups' spheres never meet there, so that
// there is no step to take.
static int nsvcd__search_begin(const nsvcd_body *moving, const nsvcd_body *fixed,
                               uint64_t segments, nsvcd__search *q) {
  q->moving = moving;
  q->fixed = fixed;
  nsvcd__chords_in_all(q, nsvcd__body_sphere(moving));
  const uint64_t all = segments & nsvcd__all_segments(q);
  const uint64_t wanted = nsvcd__meet_in(q, all, nsvcd__body_sphere(fixed));
  q->near_segments = wanted;
  q->wanted = segments;
  q->steps = 0;
  if (!nsvcd__is_tiled(moving, fixed)) {
    nsvcd__tile_fill_all(&q->moving_tile, moving);
    nsvcd__tile_fill_all(&q->fixed_tile, fixed);
    if (wanted) nsvcd__search_tile(q, wanted);
    return q->steps > 0;
  }
  q->moving_tile.count = 0;
  if (!wanted) return 0;
  nsvcd__filter *filter = nsvcd__is_large(moving) ? nsvcd__comes_near : nsvcd__exists;
  nsvcd__traversal_begin(&q->moving_traversal, moving, filter, q);
  nsvcd__search_moving_tile(q);
  return nsvcd__search_next_tile(q);
}

// No point of a group is farther from its body's origin, in the body's own units.
static float nsvcd__group_extent(const nsvcd_body *body, size_t g) {
  const nsvcd__sphere group = nsvcd__sphere_of(nsvcd__groups_of(body), g);
  return 1.000002f * (nsvcd__f3_norm(group.centre) + group.radius);
}

// Fills members[] for the segments `wanted` that are not ready.
static void nsvcd__pose_members(nsvcd__search *q, size_t g, uint64_t wanted) {
  uint64_t missing = wanted & ~q->ready;
  if (!missing) return;
  const nsvcd__spheres members = nsvcd__members_of(q->moving, g);
  q->extent = nsvcd__group_extent(q->moving, g);
  for (; missing; missing &= missing - 1) {
    const size_t s = nsvcd__low_bit(missing);
    nsvcd__chords_in_segment(q, s, members, q->extent, &q->members[s]);
  }
  q->ready |= wanted;
}

#ifndef NSVCD_NO_PROOF
// Patches of group h of the fixed body that the moving group meets, whose chords are q->group.
// segments (GROUP): in which of those `wanted`; written for these patches only.
static uint32_t nsvcd__group_against_members(const nsvcd__search *q, size_t h, uint64_t wanted,
                                             uint64_t *segments) {
  const nsvcd__spheres members = nsvcd__members_of(q->fixed, h);
  uint32_t met = 0;
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    uint32_t bits = nsvcd__meet_members(q, s, members);
    for (; bits; bits &= bits - 1) {
      const size_t l = nsvcd__low_bit(bits);
      segments[l] = (met >> l & 1 ? segments[l] : 0) | (uint64_t)1 << s;
      met |= 1u << l;
    }
  }
  return met;
}
#endif

// Turns to the next moving group in order, and to the fixed group that it meets longest.
static void nsvcd__search_group(nsvcd__search *q) {
  const size_t g = q->order[q->step];
  const uint64_t *nearby = nsvcd__nearby(q, g);
  size_t most = 0;
  q->at = 0;
  for (size_t h = 0; h < q->fixed_tile.count; h++) {
    const size_t count = nsvcd__bit_count(nearby[h] & q->wanted);
    if (count > 0) q->waiting |= (uint32_t)1 << h;
    if (count > most) {
      most = count;
      q->at = h;
    }
  }
  if (q->waiting) nsvcd__chords_of_group(q, q->moving_tile.groups[g]);
  q->ready = 0;
}

#ifndef NSVCD_NO_NETWORK
// Finds all contact intervals of moving group g, whose chords are q->group, and the members
// `which` of group h of the fixed body, in the segments `wanted`.
static void nsvcd__group_against_group(nsvcd__search *q, size_t g, size_t h, uint32_t which,
                                       uint64_t wanted, nsvcd__candidates *kept) {
  const nsvcd__spheres members = nsvcd__members_of(q->fixed, h);
  const size_t stride = q->most_segments;
  uint64_t left[NSVCD__GROUP] = {0};
  uint32_t any = 0;
  nsvcd__plane_cache *cache = q->cache;
  cache->resting_known = 0;
  wanted = nsvcd__segments_left(q, h, wanted);
  for (; wanted; wanted &= wanted - 1) {
    const size_t s = nsvcd__low_bit(wanted);
    uint32_t bits = which & nsvcd__meet_members(q, s, members);
    if (!bits) continue;
    nsvcd__pose_members(q, g, (uint64_t)1 << s);
    cache->deviation = nsvcd__segment_deviation(q, s, q->extent);
    cache->moving_known = 0;
    bits = nsvcd__members_left(q, g, s, h, bits);
    for (; bits; bits &= bits - 1) {
      const size_t k = nsvcd__low_bit(bits);
      uint16_t *met = q->met + stride * k;
      const uint32_t before = s > 0 && left[k] >> (s - 1) & 1 ? met[s - 1] : 0;
      const uint32_t lanes = nsvcd__members_meet(q, g, s, h, k, before);
      if (!lanes) continue;
      met[s] = (uint16_t)lanes;
      left[k] |= (uint64_t)1 << s;
      any |= 1u << k;
    }
  }
  for (; any; any &= any - 1) {
    const size_t k = nsvcd__low_bit(any);
    const size_t j = NSVCD__GROUP * h + k;
    const uint16_t *met = q->met + stride * k;
    const uint64_t cuts = nsvcd__interval_cuts(q, met, left[k]);
    NSVCD__EACH_SLICE(l) {
      const size_t i = NSVCD__GROUP * g + l;
      nsvcd__slice_against_patch(q, i, j, left[k], met, cuts, kept);
    }
  }
}

// Finds all contact intervals of the next pair of groups.
static void nsvcd__search_pair(nsvcd__search *q, nsvcd__candidates *kept) {
  if (!q->waiting) nsvcd__search_group(q);
  const size_t next = q->order[q->step];
  const size_t g = q->moving_tile.groups[next];
  const size_t h = q->fixed_tile.groups[q->at];
  const uint64_t wanted = nsvcd__nearby(q, next)[q->at];
  nsvcd__group_against_group(q, g, h, 0xffff, wanted, kept);
}

// A step of the search: the next pair of groups. Returns 1 if there are more.
static NSVCD__NOINLINE int nsvcd__search_step(nsvcd__search *q, nsvcd__candidates *kept) {
  nsvcd__search_pair(q, kept);
  q->waiting &= ~((uint32_t)1 << q->at);
  if (q->waiting)
    q->at = nsvcd__low_bit(q->waiting);
  else
    q->step++;
  return q->step < q->steps || nsvcd__search_next_tile(q);
}

// Instead of a search: finds all contact intervals of one moving group and one patch of the fixed
// body.
static void nsvcd__search_patch(nsvcd__search *q, const nsvcd_body *moving, size_t g,
                                const nsvcd_body *fixed, size_t j, nsvcd__candidates *kept) {
  const uint64_t all = nsvcd__all_segments(q);
  q->moving = moving;
  q->fixed = fixed;
  q->ready = 0;
  nsvcd__chords_of_group(q, g);
  nsvcd__group_against_group(q, g, j / NSVCD__GROUP, 1u << j % NSVCD__GROUP, all, kept);
}

#endif  // NSVCD_NO_NETWORK

// ========================================== triangles: two triangles over an interval, in double

// --------------------------------------------------------------------------------- triangles/poses
// In: a motion, an arc of it and a fraction u in [0,1] of the arc. Out: the pose of the moving body
// there, in double, to the last digits.

#ifndef NSVCD_NO_PROOF
// The inverse of a pose, whose rotation is times this scale.
static nsvcd__dtransform nsvcd__inverse_dtransform(const nsvcd__dtransform *at, double scale) {
  const double inverse = 1 / (scale * scale);
  nsvcd__dtransform out;
  const nsvcd__dmat3 transpose = nsvcd__dmat3_transpose(at->rotation);
  out.rotation = nsvcd__dmat3_scale(&transpose, inverse);
  out.position = nsvcd__d3_scale(nsvcd__dmat3_apply(&out.rotation, at->position), -1);
  return out;
}

// A track's slerp over an arc, and its pivot's positions at both ends, metres.
static nsvcd__slerp nsvcd__slerp_in(const nsvcd__track *track, uint32_t first, uint32_t ticks,
                                    nsvcd__d3 *ends) {
  const uint32_t k = nsvcd__pose_before(track, first);
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = track->count > 1 ? a + 1 : a;
  const uint32_t begin = nsvcd__tick_of(track, k);
  const double per_tick = 1 / (double)(nsvcd__tick_of(track, k + 1) - begin);
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  const nsvcd__d3 start = nsvcd__pivot_of(a, pivot);
  const nsvcd__d3 end = nsvcd__pivot_of(b, pivot);
  nsvcd__slerp out = nsvcd__slerp_of(a, b);
  out.fraction = (double)ticks * per_tick;
  out.from = (double)(first - begin) * per_tick;
  ends[0] = nsvcd__d3_mix(start, end, out.from);
  ends[1] = nsvcd__d3_mix(start, end, out.from + out.fraction);
  return out;
}

// The arc that begins at the keyframe `first`.
static const nsvcd__arc *nsvcd__arc_at(nsvcd__arcs *arcs, uint32_t first) {
  const nsvcd__motion *m = arcs->motion;
  nsvcd__arc *arc = &arcs->arc;
  const uint32_t ticks = nsvcd__next_keyframe(m, first) - first;
  if (arc->first == first && arc->ticks == ticks) return arc;
  nsvcd__d3 ends[2], fixed_ends[2];
  const double per_metre = 1 / (double)m->unit;
  arc->first = first;
  arc->ticks = ticks;
  arc->fixed_moves = m->fixed_moves;
  arc->scale = m->ratio;
  const nsvcd__d3 fixed_pivot = nsvcd__d3_scale(nsvcd__track_pivot(&m->fixed), per_metre);
  arc->added = nsvcd__d3_add(fixed_pivot, nsvcd__d3_widen(m->push_out));
  arc->pivot = nsvcd__d3_scale(nsvcd__track_pivot(&m->moving), per_metre);
  arc->moving = nsvcd__slerp_in(&m->moving, first, ticks, ends);
  arc->fixed = nsvcd__slerp_in(&m->fixed, first, ticks, fixed_ends);
  const nsvcd__d3 from = nsvcd__d3_sub(ends[0], fixed_ends[0]);
  const nsvcd__d3 to = nsvcd__d3_sub(ends[1], fixed_ends[1]);
  arc->from = nsvcd__d3_scale(from, per_metre);
  arc->moved = nsvcd__d3_scale(nsvcd__d3_sub(to, from), per_metre);
  if (!arc->fixed_moves) {
    // all in the fixed body's frame
    const nsvcd__dquat back = nsvcd__dquat_inverse(arc->fixed.start);
    const nsvcd__dmat3 axes = nsvcd__dmat3_of(arc->fixed.start);
    const nsvcd__dquat none = {0, 0, 0, 1};
    arc->moving.start = nsvcd__dquat_mul(back, arc->moving.start);
    arc->moving.end = nsvcd__dquat_mul(back, arc->moving.end);
    arc->from = nsvcd__dmat3_apply_transpose(&axes, arc->from);
    arc->moved = nsvcd__dmat3_apply_transpose(&axes, arc->moved);
    arc->fixed.start = arc->fixed.end = none;
  }

  // the bounds of nsvcd__cut_double_arc; of one body that turns, twist and swing are 0
  const nsvcd__d3 fixed_turn = nsvcd__slerp_turn(&arc->fixed);
  const nsvcd__d3 turn = nsvcd__d3_sub(nsvcd__slerp_turn(&arc->moving), fixed_turn);
  const nsvcd__d3 end = nsvcd__d3_add(arc->from, arc->moved);
  const double twist = nsvcd__d3_norm(nsvcd__d3_cross(turn, fixed_turn));
  const double angle = nsvcd__d3_norm(fixed_turn);
  const double swing_from = nsvcd__d3_norm(nsvcd__d3_cross(fixed_turn, arc->from));
  const double swing_to = nsvcd__d3_norm(nsvcd__d3_cross(fixed_turn, end));
  const double swing = nsvcd__max(swing_from, swing_to);
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(fixed_turn, arc->moved));
  const nsvcd__d3 axis = nsvcd__d3_unit(turn, nsvcd__d3_of(1, 0, 0));
  const nsvcd__dmat3 fixed = nsvcd__dmat3_of(nsvcd__slerp_at(&arc->fixed, 0));
  const nsvcd__dmat3 moving = nsvcd__dmat3_of(nsvcd__slerp_at(&arc->moving, 0));
  const double arm = nsvcd__d3_norm(arc->pivot);
  arc->turn = nsvcd__d3_norm(turn);
  arc->speed = nsvcd__d3_norm(arc->moved) + swing + arc->turn * arm;
  arc->twist = 0.1250001 * arc->scale * twist;
  arc->origin_bend = 0.1250001 * (2 * across + angle * swing);
  arc->origin_bend += 0.1250001 * arm * (arc->turn * arc->turn + twist);
  arc->axis = nsvcd__dmat3_apply_transpose(&fixed, axis);
  arc->own_axis = nsvcd__dmat3_apply_transpose(&moving, axis);
  arc->waver = arc->turn > 0 ? nsvcd__min(1, twist / arc->turn) : 0;
  arc->bend = 0.1250001 * arc->scale * arc->turn * arc->turn;
  return arc;
}

// Do all points of the moving body go along straight lines, as the fixed body sees them?
static int nsvcd__is_straight(const nsvcd__arc *arc) {
  return !(arc->bend > 0 || arc->twist > 0 || arc->origin_bend > 0);
}

// The true pose at fraction u of the arc, as the fixed body sees it. Its rotation is times the
// moving body's scale.
static nsvcd__dtransform nsvcd__dtransform_at(const nsvcd__arc *arc, double u) {
  nsvcd__dquat q = nsvcd__slerp_at(&arc->moving, u);
  nsvcd__dtransform at;
  at.position = nsvcd__d3_add(arc->from, nsvcd__d3_scale(arc->moved, u));
  if (arc->fixed_moves) {
    const nsvcd__dquat fixed = nsvcd__slerp_at(&arc->fixed, u);
    const nsvcd__dmat3 matrix = nsvcd__dmat3_of(fixed);
    q = nsvcd__dquat_mul(nsvcd__dquat_inverse(fixed), q);
    at.position = nsvcd__dmat3_apply_transpose(&matrix, at.position);
  }
  const nsvcd__dmat3 rotation = nsvcd__dmat3_of(q);
  at.rotation = nsvcd__dmat3_scale(&rotation, arc->scale);
  at.position = nsvcd__d3_add(at.position, arc->added);
  at.position = nsvcd__d3_sub(at.position, nsvcd__dmat3_apply(&rotation, arc->pivot));
  return at;
}

static nsvcd__d3 nsvcd__twist_of(const nsvcd__twist *twist, nsvcd__d3 x) {
  return nsvcd__d3_add(twist->along, nsvcd__d3_cross(twist->turn, x));
}

// The true pose at fraction u of p->arc, remembered: triangle pairs ask for the same poses again.
// The pose of the call before stays where it is.
static const nsvcd__dtransform *nsvcd__arc_pose(nsvcd__arcs *arcs, double u) {
  const nsvcd__arc *arc = &arcs->arc;
  const size_t next = arcs->next;
  size_t n = 0;
  for (; n < NSVCD__KNOWN_POSES; n++) {
    const nsvcd__known_pose *known = &arcs->poses[n];
    if (known->arc == arc->first && known->ticks == arc->ticks && known->u == u) break;
  }
  if (n == NSVCD__KNOWN_POSES) {
    const nsvcd__known_pose made = {arc->first, arc->ticks, u, nsvcd__dtransform_at(arc, u)};
    n = next;
    arcs->poses[n] = made;
  }
  if (n == next) arcs->next = (n + 1) % NSVCD__KNOWN_POSES;
  return &arcs->poses[n].transform;
}

static nsvcd__transform nsvcd__transform_of(const nsvcd__dtransform *at) {
  nsvcd__transform out;
  out.rotation.x = nsvcd__d3_narrow(at->rotation.x);
  out.rotation.y = nsvcd__d3_narrow(at->rotation.y);
  out.rotation.z = nsvcd__d3_narrow(at->rotation.z);
  out.position = nsvcd__f3_round(at->position);
  return out;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------- triangles/motion_bounds
// In: a segment, or an arc and two fractions of it. Out: an interval: the poses at both ends, and
// how far points deviate from their chords in between.

#ifndef NSVCD_NO_PROOF
// A segment, up to the end of what matters; kept once it has been made.
static const nsvcd__interval *nsvcd__segment_interval(nsvcd__solver *w, const nsvcd__search *q,
                                                      size_t s) {
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  nsvcd__interval *out = &w->intervals[s];
  if (w->memo.intervals >> s & 1) return out;
  w->memo.intervals |= (uint64_t)1 << s;
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, l);
  out->start.rotation = nsvcd__mat3_lane(block->rotation, l);
  out->end.rotation = nsvcd__mat3_mix(1, &out->start.rotation, 1, &turned);
  out->start.position = nsvcd__lane_of(block->position, l);
  out->end.position = nsvcd__f3_add(out->start.position, nsvcd__lane_of(block->moved, l));
  out->bend = block->bend[l];
  out->rounding = block->rounding[l];
  out->origin_bend = block->origin_bend[l];
  out->axis = nsvcd__lane_of(block->axis, l);
  out->heading = nsvcd__lane_of(block->heading, l);
  out->bend_along_axis = block->bend_along_axis[l];
  out->origin_along_axis = block->origin_along_axis[l];
  out->origin_off_heading = block->origin_off_heading[l];
  return out;
}

// The interval from u0 to u1 of the arc that begins at the keyframe `first`.
static nsvcd__interval nsvcd__interval_of_arc(nsvcd__proof *p, uint32_t first, double u0,
                                              double u1) {
  const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, first);
  const nsvcd__dtransform start = nsvcd__dtransform_at(arc, u0);
  const nsvcd__dtransform end = nsvcd__dtransform_at(arc, u1);
  const double square = (u1 - u0) * (u1 - u0);
  nsvcd__interval out;
  out.start = nsvcd__transform_of(&start);
  out.end = nsvcd__transform_of(&end);
  const float extent_start = nsvcd__f3_norm(out.start.position);
  const float extent = extent_start + nsvcd__f3_norm(out.end.position);
  out.bend = (float)(square * (arc->bend + arc->twist) * 1.000001);
  out.origin_bend = (float)(square * arc->origin_bend * 1.000001);
  out.rounding = NSVCD__ROUNDING * (extent + p->given.lengths);
  out.origin_along_axis = out.origin_off_heading = out.origin_bend;
  out.axis = nsvcd__f3_round(arc->axis);
  out.heading = out.axis;  // any
  const double wavers = square * (arc->bend * arc->waver + arc->twist);
  out.bend_along_axis = fminf((float)wavers + 1e-6f * out.bend, out.bend);
  return out;
}

// The axis in the moving body's frame, unit.
static nsvcd__f3 nsvcd__own_axis(const nsvcd__interval *over) {
  const nsvcd__f3 axis = nsvcd__mat3_apply_transpose(&over->start.rotation, over->axis);
  const float length = nsvcd__f3_norm(axis);
  return nsvcd__f3_scale(axis, length > 0 ? 1 / length : 0);
}

// How far points of the moving body are, at most, in its own units: from its origin, and from the
// line through that along the axis of a turn.
typedef struct nsvcd__arm {
  float from_origin, from_axis;
} nsvcd__arm;

// Of a sphere. axis: unit to rounding, in the body's frame.
static nsvcd__arm nsvcd__arm_of(nsvcd__f3 centre, float radius, nsvcd__f3 axis) {
  const float distance = nsvcd__f3_norm(centre);
  const float aside = nsvcd__f3_norm(nsvcd__f3_cross(centre, axis));
  const nsvcd__arm out = {1.000001f * (distance + radius),
                          1.000001f * (aside + radius) + 1e-6f * distance};
  return out;
}

// Of a patch's pieces.
static nsvcd__arm nsvcd__patch_arm(const nsvcd__geometry *f, size_t patch,
                                   const nsvcd__interval *over) {
  const float radius = nsvcd__body_r(f->body)[patch];
  return nsvcd__arm_of(nsvcd__patch_centre(f, patch), radius, nsvcd__own_axis(over));
}

// The deviation that the turn causes, along any direction: |D x|, with D the difference between the
// true rotation and the chord's at some time. Split x into its parts along a', the axis in the
// moving body's frame, and across it: then
//   |D x| <= |D| |x x a'| + |D a'| |x.a'|
// and |D a'| is |D^T axis|, since both ends of the chord take a' to the axis.
static float nsvcd__bend_of(const nsvcd__interval *over, nsvcd__arm arm) {
  const float by_axis = over->bend * arm.from_axis + over->bend_along_axis * arm.from_origin;
  return fminf(over->bend * arm.from_origin, by_axis);
}

// The deviation of points of the moving body along a direction n, times its length, without
// rounding (which is times |n| too). With d the difference of the positions, a point x is off by
// n.(D x + d). Split n into its parts along the axis and across it: then
//   |n.D x| <= |n.axis| |D^T axis| |x| + |n x axis| |D x|
// and |n.d| is bounded in the same way, or with the heading in place of the axis.
static float nsvcd__deviation_of(const nsvcd__interval *over, nsvcd__f3 n, nsvcd__arm arm) {
  const float along = fabsf(nsvcd__f3_dot(n, over->axis));
  const float across = nsvcd__f3_norm(nsvcd__f3_cross(n, over->axis));
  const float ahead = fabsf(nsvcd__f3_dot(n, over->heading));
  const float aside = nsvcd__f3_norm(nsvcd__f3_cross(n, over->heading));
  const float by_axis = along * over->origin_along_axis + across * over->origin_bend;
  const float by_heading = ahead * over->origin_bend + aside * over->origin_off_heading;
  const float origin_bend = by_axis < by_heading ? by_axis : by_heading;
  const float turn = along * over->bend_along_axis * arm.from_origin;
  return origin_bend + turn + across * nsvcd__bend_of(over, arm);
}

#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------ triangles/triangle_pairs
// In: two triangles and an interval. Out: they are separated, or in contact, or too near to tell.

#ifndef NSVCD_NO_PROOF
// The unit normal of a triangle; 0 if the triangle has no area. Rounding, or fused arithmetic,
// makes such a triangle's normal some 1e-16 of its longest edge squared.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__face_direction(const nsvcd__d3 *t) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  double longest = 0;
  for (size_t k = 0; k < 3; k++)
    longest = nsvcd__max(longest, nsvcd__d3_distance2(t[k], t[(k + 1) % 3]));
  const double length = nsvcd__d3_norm(n);
  return nsvcd__d3_scale(n, length > 1e-9 * longest ? 1 / length : 0);
}

static void nsvcd__pose_triangle(const nsvcd__dtransform *at, const nsvcd__d3 *corners,
                                 nsvcd__d3 *out) {
  for (size_t k = 0; k < 3; k++) out[k] = nsvcd__d3_transform(at, corners[k]);
}

// Two triangles, one of each body, in their frames: the caller's own, of which entries may be
// pieces. A plane that separates a triangle separates its pieces; what meets a triangle meets the
// mesh.
typedef struct nsvcd__triangle_pair {
  size_t moving_patch, fixed_patch, moving_entry, fixed_entry;
  nsvcd__d3 moving[3], fixed[3];
  // The greatest distance of the moving one's points from their body's origin and, at any time of
  // the arc, from the axis of the turn; in its body's units.
  double from_origin, from_axis;
  // of the moving one, at most: the path of a point over the arc
  double speed;
  // how far the meshes' own triangles may be off, and rounding in double; and that rounding alone
  double margin;
  double rounding;
  // too near to halve the interval for
  double close;
} nsvcd__triangle_pair;

// Sets from_origin and from_axis.
static void nsvcd__pair_arm(const nsvcd__arc *arc, nsvcd__triangle_pair *pair) {
  pair->from_origin = pair->from_axis = 0;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 corner = pair->moving[k];
    const nsvcd__d3 across = nsvcd__d3_cross(corner, arc->own_axis);
    pair->from_origin = nsvcd__max(pair->from_origin, nsvcd__d3_norm(corner));
    pair->from_axis = nsvcd__max(pair->from_axis, nsvcd__d3_norm(across));
  }
  pair->from_axis += (arc->waver + 1e-6) * pair->from_origin;
  pair->from_axis = nsvcd__min(pair->from_axis, pair->from_origin);
}

static nsvcd__triangle_pair nsvcd__pair_of(const nsvcd__proof *p, size_t i, size_t j, size_t a,
                                           size_t b) {
  nsvcd__triangle_pair pair = {i, j, a, b, {{0, 0, 0}}, {{0, 0, 0}}, 0, 0, 0, 0, 0, 0};
  nsvcd__patch_triangle(&p->moving, i, a, pair.moving);
  nsvcd__patch_triangle(&p->fixed, j, b, pair.fixed);
  nsvcd__pair_arm(&p->arcs.arc, &pair);
  pair.speed = p->arcs.arc.speed + p->arcs.arc.turn * p->arcs.arc.scale * pair.from_axis;
  pair.rounding =
      NSVCD__SAME_POSITION * ((double)p->given.lengths + nsvcd__d3_norm(p->arcs.arc.from));
  pair.margin = pair.rounding + nsvcd__off_meshes(p);
  pair.margin += NSVCD__SAME_POSITION * nsvcd__d3_norm(p->arcs.arc.moved);
  pair.close = pair.margin + NSVCD__TOO_NEAR * (double)p->given.lengths + p->given.tolerance;
  return pair;
}

// Are these of closed surfaces, whose winding says which side is out?
static int nsvcd__moving_closed(const nsvcd__proof *p, const nsvcd__triangle_pair *c) {
  return nsvcd__is_in_solid(&p->moving, c->moving_patch, c->moving_entry);
}
static int nsvcd__fixed_closed(const nsvcd__proof *p, const nsvcd__triangle_pair *c) {
  return nsvcd__is_in_solid(&p->fixed, c->fixed_patch, c->fixed_entry);
}

// The nearest points of a triangle pair at fraction u of the arc.
static nsvcd__nearest nsvcd__pair_nearest(nsvcd__arcs *arcs, const nsvcd__triangle_pair *pair,
                                          double u) {
  nsvcd__d3 moving[3];
  nsvcd__pose_triangle(nsvcd__arc_pose(arcs, u), pair->moving, moving);
  return nsvcd__nearest_of(moving, pair->fixed);
}

// The contact of two triangles at fraction u of the arc.
static nsvcd__pair_contact nsvcd__contact_at(const nsvcd__proof *p,
                                             const nsvcd__triangle_pair *pair, double u,
                                             const nsvcd__nearest *nearest) {
  const nsvcd__d3 face = nsvcd__face_direction(pair->fixed);
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest->on_a, nearest->on_b);
  const double distance = sqrt(nearest->square);
  const int touches = distance <= pair->rounding;
  nsvcd__pair_contact out;
  out.tick = (double)p->arcs.arc.first + u * (double)p->arcs.arc.ticks;
  out.distance = touches ? 0 : distance;
  out.point = nearest->on_b;
  out.normal = touches ? face : nsvcd__d3_unit(apart, nsvcd__d3_of(0, 0, 0));
  out.moving_triangle =
      nsvcd__triangle_number(&p->moving, pair->moving_patch, pair->moving_entry);
  out.fixed_triangle = nsvcd__triangle_number(&p->fixed, pair->fixed_patch, pair->fixed_entry);
  out.moving_entry = (uint32_t)pair->moving_entry;
  out.fixed_entry = (uint32_t)pair->fixed_entry;
  out.moving_patch = (uint16_t)pair->moving_patch;
  out.fixed_patch = (uint16_t)pair->fixed_patch;
  return out;
}

// Two triangles come within the clearance at fraction u of the arc. ANSWERED: that is an answer;
// SHRUNK: there may be a better one.
static nsvcd__outcome nsvcd__take_contact(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                          double u, const nsvcd__nearest *nearest) {
  p->known.has_contact = 1;
  p->known.found = nsvcd__contact_at(p, pair, u, nearest);
  if (p->goal.measure > 0) {
    p->goal.high = p->known.found.distance;
    p->goal.clearance = nsvcd__max(p->goal.low, p->goal.high - p->goal.measure);
    return p->goal.clearance > p->goal.low ? NSVCD__SHRUNK : NSVCD__ANSWERED;
  }
  if (p->goal.first > 0) {
    p->known.end = p->known.found.tick - p->goal.first;
    return p->known.end > 0 ? NSVCD__SHRUNK : NSVCD__ANSWERED;
  }
  return NSVCD__ANSWERED;
}

// Two triangles come too near to each other, from u0 to u1 of the arc, to tell whether they touch.
static NSVCD__NOINLINE void nsvcd__keep_unresolved(nsvcd__proof *p,
                                                   const nsvcd__triangle_pair *pair, double u0,
                                                   double u1) {
  const double tick = (double)p->arcs.arc.first + u0 * (double)p->arcs.arc.ticks;
  const double middle = 0.5 * (u0 + u1);
  const size_t left = p->goal.after_unresolved;
  // a brief first attempt has no budget to save
  const int is_first = !(p->known.unresolved < NSVCD__NEVER) && !p->goal.is_brief;
  if (is_first && p->work + left < p->goal.limit) p->goal.limit = p->work + left;
  if (!(tick < p->known.unresolved)) return;
  const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
  p->known.unresolved_pair = nsvcd__contact_at(p, pair, middle, &nearest);
  p->known.unresolved = tick;
  if (p->goal.unresolved_ends) p->known.end = nsvcd__min(p->known.end, tick);
}

// The fraction of the arc from which on nothing matters.
static double nsvcd__arc_limit(const nsvcd__proof *p) {
  return (p->known.end - (double)p->arcs.arc.first) / (double)p->arcs.arc.ticks;
}

// The deviation of a triangle pair's moving triangle along a unit direction n over the whole arc.
// Over a fraction of the arc it is the square of that fraction times as large. A point at r metres
// from the origin and rho from the axis a of the turn deviates by bend rho |n x a| + twist r +
// origin_bend. Where both bodies turn, a wavers, and so do both distances from it.
static double nsvcd__off_chord_along(const nsvcd__arc *arc, const nsvcd__triangle_pair *pair,
                                     nsvcd__d3 n) {
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(n, arc->axis));
  const double off_axis = nsvcd__min(1, across + arc->waver + 1e-6);
  const double turn = arc->bend * pair->from_axis * off_axis;
  return turn + arc->twist * pair->from_origin + arc->origin_bend;
}

// Does the plane that separated a triangle pair last separate this one from u0 to u1 of the arc?
static int nsvcd__plane_separates(nsvcd__proof *p, const nsvcd__triangle_pair *pair, double u0,
                                  double u1) {
  const nsvcd__d3 normal = p->separating;
  const nsvcd__dtransform *start = nsvcd__arc_pose(&p->arcs, u0);
  const nsvcd__dtransform *end = nsvcd__arc_pose(&p->arcs, u1);
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 at_start = nsvcd__d3_transform(start, pair->moving[k]);
    const nsvcd__d3 at_end = nsvcd__d3_transform(end, pair->moving[k]);
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_start));
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_end));
    highest = nsvcd__max(highest, nsvcd__d3_dot(normal, pair->fixed[k]));
  }
  const double off = nsvcd__off_chord_along(&p->arcs.arc, pair, normal);
  const double deviation = (u1 - u0) * (u1 - u0) * off;
  return lowest - highest > p->goal.clearance + pair->margin + deviation;
}

// Have two heights different signs, clear of 0 by their margins?
static int nsvcd__are_opposite(double before, double least_before, double after,
                               double least_after) {
  const int falls = before > least_before && after < -least_after;
  const int rises = before < -least_before && after > least_after;
  return falls || rises;
}

// In the next three, triangles are given at three times: the start, the middle and the end of an
// interval. Between two of them no point travels farther than `travel`, relative to the other
// triangle.

// Does corner k of triangle x pass through triangle t: does it change sides, and is its foot, in
// the middle, well within t?
static int nsvcd__corner_passes(const nsvcd__d3 *const *x, size_t k, const nsvcd__d3 *const *t,
                                double travel, double margin) {
  const nsvcd__d3 n = nsvcd__face_normal(t[1]);
  const double room = 2 * travel * nsvcd__d3_norm(n);
  for (size_t e = 0; e < 3; e++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[1][(e + 1) % 3], t[1][e]);
    const nsvcd__d3 from = nsvcd__d3_sub(x[1][k], t[1][e]);
    const double within = nsvcd__d3_dot(n, nsvcd__d3_cross(edge, from));
    if (!(within > room * nsvcd__d3_norm(edge))) return 0;
  }
  const nsvcd__d3 n0 = nsvcd__face_normal(t[0]);
  const nsvcd__d3 n2 = nsvcd__face_normal(t[2]);
  const double before = nsvcd__d3_dot(n0, nsvcd__d3_sub(x[0][k], t[0][0]));
  const double after = nsvcd__d3_dot(n2, nsvcd__d3_sub(x[2][k], t[2][0]));
  return nsvcd__are_opposite(before, margin * nsvcd__d3_norm(n0), after,
                             margin * nsvcd__d3_norm(n2));
}

// Does edge k of the moving triangle pass through edge n of the fixed one: do they change sides,
// and are their lines, in the middle, nearest to each other well within both? The side is the sign
// of the volume of the tetrahedron of both.
static int nsvcd__edges_pass(const nsvcd__d3 *const *moving, size_t k, const nsvcd__d3 *fixed,
                             size_t n, double travel, double margin) {
  const size_t next = (k + 1) % 3;
  const nsvcd__d3 v = nsvcd__d3_sub(fixed[(n + 1) % 3], fixed[n]);
  nsvcd__d3 across[3], from[3];
  double volumes[3];
  for (size_t at = 0; at < 3; at++) {
    const nsvcd__d3 *a = moving[at];
    across[at] = nsvcd__d3_cross(nsvcd__d3_sub(a[next], a[k]), v);
    from[at] = nsvcd__d3_sub(fixed[n], a[k]);
    volumes[at] = nsvcd__d3_dot(across[at], from[at]);
  }
  const nsvcd__d3 u = nsvcd__d3_sub(moving[1][next], moving[1][k]);
  const double size = nsvcd__d3_norm(across[1]);
  const double lengths = nsvcd__d3_norm(u) * nsvcd__d3_norm(v);
  if (!(size > 0.01 * lengths)) return 0;
  if (!nsvcd__are_opposite(volumes[0], margin * size, volumes[2], margin * size)) return 0;
  const double square = size * size;
  const double s = nsvcd__d3_dot(nsvcd__d3_cross(from[1], v), across[1]) / square;
  const double t = nsvcd__d3_dot(nsvcd__d3_cross(from[1], u), across[1]) / square;
  // the lines' nearest points travel no farther along them
  const double room = 4 * travel * lengths / size;
  const double room_s = room / nsvcd__d3_norm(u);
  const double room_t = room / nsvcd__d3_norm(v);
  return s > room_s && s < 1 - room_s && t > room_t && t < 1 - room_t;
}

// Has a triangle pair met between u0 and u1 of the arc: has a corner passed through the other
// triangle, or an edge through an edge? Faces that are parallel when they meet do so at
// one time only, and rounded numbers show it at none.
static int nsvcd__pair_passes(nsvcd__arcs *arcs, const nsvcd__triangle_pair *pair, double u0,
                              double u1) {
  const double margin = pair->rounding;
  const double travel = pair->speed * (u1 - u0);
  const double times[3] = {u0, 0.5 * (u0 + u1), u1};
  nsvcd__d3 corners[3][3];
  for (size_t n = 0; n < 3; n++)
    nsvcd__pose_triangle(nsvcd__arc_pose(arcs, times[n]), pair->moving, corners[n]);
  const nsvcd__d3 *moving[3] = {corners[0], corners[1], corners[2]};
  const nsvcd__d3 *fixed[3] = {pair->fixed, pair->fixed, pair->fixed};
  for (size_t k = 0; k < 3; k++) {
    if (nsvcd__corner_passes(moving, k, fixed, travel, margin)) return 1;
    if (nsvcd__corner_passes(fixed, k, moving, travel, margin)) return 1;
    for (size_t n = 0; n < 3; n++)
      if (nsvcd__edges_pass(moving, k, pair->fixed, n, travel, margin)) return 1;
  }
  return 0;
}

// How far a triangle is beyond another along a direction. Heights are over a corner of the one, to
// lose as few digits as possible.
static double nsvcd__beyond(nsvcd__d3 n, const nsvcd__d3 *over, const nsvcd__d3 *under) {
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(n, nsvcd__d3_sub(over[k], under[0])));
    highest = nsvcd__max(highest, nsvcd__d3_dot(n, nsvcd__d3_sub(under[k], under[0])));
  }
  return lowest - highest;
}

// The direction across an edge of each of two triangles, unit: the k-th of 9. 0 if they are
// parallel.
static nsvcd__d3 nsvcd__across_edges(const nsvcd__d3 *a, const nsvcd__d3 *b, size_t k) {
  const nsvcd__d3 u = nsvcd__d3_sub(a[(k + 1) % 3], a[k % 3]);
  const nsvcd__d3 v = nsvcd__d3_sub(b[(k / 3 + 1) % 3], b[k / 3]);
  return nsvcd__d3_unit(nsvcd__d3_cross(u, v), nsvcd__d3_of(0, 0, 0));
}

// A direction made normal to the edge from a to b, unit; 0 if it is along that.
static nsvcd__d3 nsvcd__off_edge(nsvcd__d3 n, nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 none = nsvcd__d3_of(0, 0, 0);
  const nsvcd__d3 edge = nsvcd__d3_unit(nsvcd__d3_sub(b, a), none);
  const nsvcd__d3 along = nsvcd__d3_scale(edge, nsvcd__d3_dot(n, edge));
  return nsvcd__d3_unit(nsvcd__d3_sub(n, along), none);
}

// The direction that separates a triangle pair at a time: that of its nearest points. Rounding
// turns it by their roundings over their distance, or by the root of that if several points are as
// near to the last digit. If it keeps less than half of what is above the clearance, others may
// keep more: the normals of the triangles, itself made normal to an edge, and those across an edge
// of each. Returns how far the chosen one separates them.
static NSVCD__NOINLINE double nsvcd__aim_plane(nsvcd__proof *p,
                                               const nsvcd__triangle_pair *pair, double u,
                                               const nsvcd__nearest *nearest) {
  const double distance = sqrt(nearest->square);
  nsvcd__d3 *plane = &p->separating;
  *plane = nsvcd__d3_scale(nsvcd__d3_sub(nearest->on_a, nearest->on_b), 1 / distance);
  const nsvcd__d3 *fixed = pair->fixed;
  const nsvcd__d3 guess = *plane;
  nsvcd__d3 moving[3];
  nsvcd__pose_triangle(nsvcd__arc_pose(&p->arcs, u), pair->moving, moving);
  double best = nsvcd__beyond(guess, moving, fixed);
  const double limit = p->goal.clearance + pair->margin;
  if (best - limit > 0.5 * (distance - limit)) return best;
  for (size_t k = 0; k < 17; k++) {
    const nsvcd__d3 *of = k % 2 ? fixed : moving;
    nsvcd__d3 n = k < 2   ? nsvcd__face_direction(of)
                  : k < 8 ? nsvcd__off_edge(guess, of[k / 2 - 1], of[k / 2 % 3])
                          : nsvcd__across_edges(moving, fixed, k - 8);
    if (nsvcd__d3_dot(n, guess) < 0) n = nsvcd__d3_scale(n, -1);
    const double beyond = nsvcd__beyond(n, moving, fixed);
    if (!(beyond > best)) continue;
    *plane = n;
    best = beyond;
  }
  return best;
}

// A triangle pair that is too near to tell from u0 to u1 of the arc, the nearest at `when`, is kept
// as unresolved. DISTANCE needs only a bound of how near the pair comes, so it lowers the clearance
// to that. TOO_LONG: resolve the part again; ANSWERED: the clearance is at its known bound.
static nsvcd__outcome nsvcd__resolve_too_near(nsvcd__proof *p,
                                              const nsvcd__triangle_pair *pair, double u0,
                                              double u1, double when) {
  if (!(p->goal.measure > 0)) {
    nsvcd__keep_unresolved(p, pair, u0, u1);
    return NSVCD__DONE;
  }
  const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, when);
  const double distance = sqrt(nearest.square);
  if (distance < p->goal.high) (void)nsvcd__take_contact(p, pair, when, &nearest);
  const double separated = distance - 2 * pair->close;
  p->goal.clearance = nsvcd__max(p->goal.low, nsvcd__min(p->goal.clearance, separated));
  return p->goal.clearance > p->goal.low ? NSVCD__TOO_LONG : NSVCD__ANSWERED;
}

// Resolves a part of the arc that is too short to halve. If the triangle pair has passed, the time
// is narrowed down to rounding, and is the contact's. If not, it is unresolved.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_short_interval(
    nsvcd__proof *p, const nsvcd__triangle_pair *pair, double u0, double u1) {
  if (!nsvcd__pair_passes(&p->arcs, pair, u0, u1))
    return nsvcd__resolve_too_near(p, pair, u0, u1, 0.5 * (u0 + u1));
  for (size_t n = 0; n < NSVCD__HALVINGS; n++) {
    const double middle = 0.5 * (u0 + u1);
    p->work++;
    if (nsvcd__pair_passes(&p->arcs, pair, u0, middle))
      u1 = middle;
    else if (nsvcd__pair_passes(&p->arcs, pair, middle, u1))
      u0 = middle;
    else
      break;
  }
  const double when = 0.5 * (u0 + u1);
  nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, when);
  nearest.square = 0;
  return nsvcd__take_contact(p, pair, when, &nearest);
}

// Where the least distance is measured and the moving body goes straight, by `moved` over the arc:
// finds when between u0 and u1 a triangle pair is nearest. Its distance is convex, and falls while
// the nearest points approach each other. Steps of `measure` would not get there.
static nsvcd__outcome nsvcd__take_nearest(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                          double u0, double u1, nsvcd__d3 moved) {
  for (size_t n = 0; n < NSVCD__HALVINGS / 2; n++) {
    const double middle = 0.5 * (u0 + u1);
    const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    p->work++;
    if (sqrt(nearest.square) < p->goal.high &&
        nsvcd__take_contact(p, pair, middle, &nearest) == NSVCD__ANSWERED)
      return NSVCD__ANSWERED;
    const double slope = nsvcd__d3_dot(apart, moved) / sqrt(nearest.square);
    // the distance is nowhere below its tangent
    if (!(fabs(slope) * (u1 - u0) > p->goal.measure)) break;
    if (slope < 0)
      u0 = middle;
    else
      u1 = middle;
  }
  return NSVCD__SHRUNK;
}

// Resolves a triangle pair from u0 to u1 of an arc in which the moving body goes straight. Then its
// distance is a convex function of time, and the plane at its nearest points is a tangent: Newton's
// method, from the start on, comes to the first contact and never past it. The plane that separated
// a pair last is tried first.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_straight(nsvcd__proof *p,
                                                              const nsvcd__triangle_pair *pair,
                                                              double u0, double u1) {
  const nsvcd__arc *arc = &p->arcs.arc;
  const nsvcd__d3 from = nsvcd__arc_pose(&p->arcs, 0)->position;
  const nsvcd__d3 moved = nsvcd__d3_sub(nsvcd__arc_pose(&p->arcs, 1)->position, from);
  double at = u0;
  int shrunk = 0;
  size_t steps = 0;
  const double all = nsvcd__min(u1, nsvcd__arc_limit(p));
  if (u0 < all && nsvcd__plane_separates(p, pair, u0, all)) {
    p->work++;
    return NSVCD__DONE;
  }
  for (double u = u0;;) {  // until u it is separated
    const double end = nsvcd__min(u1, nsvcd__arc_limit(p));
    if (!(u < end)) return shrunk ? NSVCD__SHRUNK : NSVCD__DONE;
    at = nsvcd__min(at, end);
    p->work++;
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, at);
    const double distance = sqrt(nearest.square);
    const double above = distance - p->goal.clearance;
    if (above <= pair->rounding) {
      if (nsvcd__take_contact(p, pair, at, &nearest) == NSVCD__ANSWERED)
        return NSVCD__ANSWERED;
      if (p->goal.measure > 0 &&
          nsvcd__take_nearest(p, pair, u, end, moved) == NSVCD__ANSWERED)
        return NSVCD__ANSWERED;
      shrunk = 1;
      at = u;
      continue;
    }
    const double beyond = nsvcd__aim_plane(p, pair, at, &nearest);
    const double fall = -nsvcd__d3_dot(p->separating, moved);
    const double room = beyond - p->goal.clearance - pair->margin - pair->rounding;
    const double until = fall > 0 ? nsvcd__min(end, at + room / fall) : end;
    if (u < until && nsvcd__plane_separates(p, pair, u, until)) u = until;
    const int is_short = !(room > 0) || arc->speed * (at - u) <= 0.25 * pair->close;
    const int is_unresolved = fall > 0 ? !(at < end) : is_short;
    if (u < end && (is_unresolved || steps++ == NSVCD__HALVINGS)) {
      // what follows is no nearer
      const nsvcd__outcome part = nsvcd__resolve_too_near(p, pair, u, at, at);
      if (part == NSVCD__ANSWERED) return part;
      if (part == NSVCD__DONE) u = end;
    } else {
      at = fall > 0 ? at + above / fall : 0.5 * (u + at);
    }
  }
}

// Resolves a triangle pair from u0 to u1 of the arc: halves the time until, in each part, a plane
// separates the triangles, or there is a contact, or they are too near to tell. After each
// unresolved part, longer ones count as too short: the question left is whether they meet. The
// planes tried are the one that separated a pair last, and the one that nsvcd__aim_plane finds.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_pair(nsvcd__proof *p,
                                                          const nsvcd__triangle_pair *pair,
                                                          double u0, double u1) {
  if (nsvcd__is_straight(&p->arcs.arc)) return nsvcd__resolve_straight(p, pair, u0, u1);
  double *ends = p->pair_ends;
  size_t left = 1;
  size_t unresolved_count = 0;
  int shrunk = 0;
  ends[0] = u1;
  for (double u = u0; left > 0;) {
    const double end = nsvcd__min(ends[left - 1], nsvcd__arc_limit(p));
    if (!(u < end)) break;  // an unresolved pair may be the end
    const double middle = 0.5 * (u + end);
    p->work++;
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    int apart = nsvcd__plane_separates(p, pair, u, end);
    if (!apart) {
      const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
      const double distance = sqrt(nearest.square);
      if (distance <= p->goal.clearance + pair->rounding) {
        if (nsvcd__take_contact(p, pair, middle, &nearest) == NSVCD__ANSWERED)
          return NSVCD__ANSWERED;
        shrunk = 1;
        continue;
      }
      (void)nsvcd__aim_plane(p, pair, middle, &nearest);
      apart = nsvcd__plane_separates(p, pair, u, end);
    }
    if (!apart) {
      const double least = 0.25 * pair->close * (double)(1 + unresolved_count);
      const int is_short = pair->speed * (end - u) <= least || left > NSVCD__HALVINGS;
      if (!is_short) {
        ends[left++] = middle;
        p->parts++;
        continue;
      }
      const nsvcd__outcome part = nsvcd__resolve_short_interval(p, pair, u, end);
      if (part == NSVCD__ANSWERED) return part;
      shrunk |= part == NSVCD__SHRUNK;
      if (part != NSVCD__DONE) continue;
      unresolved_count++;
    }
    u = end;
    left--;
  }
  return shrunk ? NSVCD__SHRUNK : NSVCD__DONE;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------- triangles/touches
// In: two triangles that touch at the start of a motion. Out: how deep, and which directions undo
// it.

#ifndef NSVCD_NO_PROOF
// How deep a touch is along n: how far the moving triangle must go to be beyond the other; negative
// if it is beyond it already.
static double nsvcd__depth_along(nsvcd__d3 n, const nsvcd__touch *t) {
  return -nsvcd__beyond(n, t->moving, t->fixed);
}

// Is a touch too deep for the slop in every direction? Those to try are the separating axes: a
// normal of either triangle, or across an edge of each.
static int nsvcd__is_deep(const nsvcd__proof *p, const nsvcd__touch *t) {
  const nsvcd__d3 push_out = nsvcd__d3_widen(p->arcs.motion->push_out);
  const double most = p->push.slop - p->given.clearance;
  for (size_t k = 0; k < 12; k++) {
    nsvcd__d3 n = k < 3 ? t->directions[k] : nsvcd__across_edges(t->moving, t->fixed, k - 3);
    if (!(nsvcd__d3_dot(n, n) > 0.5)) continue;
    for (int side = 0; side < 2; side++) {
      const double pushed_out = nsvcd__d3_dot(push_out, n);
      if (pushed_out + nsvcd__depth_along(n, t) <= most) return 0;
      n = nsvcd__d3_scale(n, -1);
    }
  }
  return 1;
}

// Does a push-out along n, by what is left of the slop in that direction, undo a touch? If it has
// to push, it must not go through both faces. Going through one is harmless: a cone's side, which
// rises from the rim that the cone stands on, looks up, and so does the floor under it.
static int nsvcd__undoes(const nsvcd__proof *p, nsvcd__d3 n, const nsvcd__touch *t) {
  const double more = nsvcd__depth_along(n, t);
  const double pushed_out = nsvcd__d3_dot(nsvcd__d3_widen(p->arcs.motion->push_out), n);
  if (!(nsvcd__d3_dot(n, n) > 0.5)) return 0;
  if (pushed_out + more + p->given.clearance > p->push.slop) return 0;
  if (more < 0) return 1;
  return nsvcd__d3_dot(n, t->directions[0]) > -0.3 ||
         nsvcd__d3_dot(n, t->directions[1]) > -0.3;
}

// The squared distance of two triangles after the moving one has gone so far along n.
static double nsvcd__gap_after(const nsvcd__touch *t, nsvcd__d3 n, double distance) {
  nsvcd__d3 moved[3];
  for (int k = 0; k < 3; k++)
    moved[k] = nsvcd__d3_add(t->moving[k], nsvcd__d3_scale(n, distance));
  return nsvcd__nearest_of(moved, t->fixed).square;
}

// How far along n the moving triangle of a touch must go until it is beyond the clearance for good,
// which it is after `most`; -HUGE_VAL if it never is within it. The distance is convex: thirds find
// where it is least, and halves where it is the clearance. epsilon: of depths, in double.
static NSVCD__NOINLINE double nsvcd__exit_depth(const nsvcd__touch *t, nsvcd__d3 n,
                                                double clearance, double most,
                                                double epsilon) {
  // Parallel faces meet at one time only.
  const double limit = clearance + nsvcd__min(0.003 * most, epsilon);
  const double square = limit * limit;
  // nearly always
  if (nsvcd__gap_after(t, n, 0.998 * most) <= square) return most;
  double low = 0;
  double high = most;
  double inner = 0;  // where it is within the clearance
  int met = nsvcd__gap_after(t, n, 0) <= square;
  for (int k = 0; k < 16 && !met; k++) {
    const double third = (high - low) / 3;
    const double before = nsvcd__gap_after(t, n, low + third);
    const double after = nsvcd__gap_after(t, n, high - third);
    met = before <= square || after <= square;
    inner = after <= square ? high - third : low + third;
    if (before < after) high -= third;
    if (!(before < after)) low += third;
  }
  if (!met) return -HUGE_VAL;
  for (double beyond = most; beyond - inner > nsvcd__max(1e-3 * beyond, 1e-5 * most);) {
    const double middle = 0.5 * (inner + beyond);
    const int is_inner = nsvcd__gap_after(t, n, middle) <= square;
    *(is_inner ? &inner : &beyond) = middle;
  }
  return inner;
}

// Notes how deep a touch is along normal k.
static void nsvcd__note_depth(nsvcd__proof *p, size_t k, const nsvcd__touch *t) {
  const nsvcd__d3 n = p->push.normals[k];
  const double pushed_out = nsvcd__d3_dot(nsvcd__d3_widen(p->arcs.motion->push_out), n);
  const double most = nsvcd__depth_along(n, t) + p->given.clearance;
  p->push.needed = nsvcd__max(p->push.needed, pushed_out + most);
  if (!(most > 0) || !(pushed_out + most > p->push.depths[k])) return;
  const double epsilon = nsvcd__off_meshes(p) + NSVCD__TOO_NEAR * (double)p->given.lengths;
  const double depth = pushed_out + nsvcd__exit_depth(t, n, p->given.clearance, most, epsilon);
  p->push.depths[k] = nsvcd__max(p->push.depths[k], depth);
}

// Does normal k undo a touch? Then its depth is noted.
static int nsvcd__undone_by(nsvcd__proof *p, size_t k, const nsvcd__touch *t) {
  if (!nsvcd__undoes(p, p->push.normals[k], t)) return 0;
  nsvcd__note_depth(p, k, t);
  return 1;
}

// Keeps two triangles that are within the clearance at the start, unless a known direction undoes
// that.
static void nsvcd__collect_contact(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                   const nsvcd__d3 *posed) {
  nsvcd__touch contact;
  memcpy(contact.moving, posed, sizeof contact.moving);
  memcpy(contact.fixed, pair->fixed, sizeof contact.fixed);
  const nsvcd__nearest nearest = nsvcd__nearest_of(posed, pair->fixed);
  const int are_apart = nearest.square > 1e6 * pair->rounding * pair->rounding;
  const nsvcd__d3 distance = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
  contact.directions[0] = nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
  contact.directions[1] = nsvcd__face_direction(pair->fixed);
  contact.directions[2] = nsvcd__d3_scale(distance, are_apart ? 1 / sqrt(nearest.square) : 0);
  for (size_t k = 0; k < p->push.normal_count; k++) {
    if (nsvcd__undone_by(p, k, &contact)) return;
  }
  p->push.too_deep = p->push.too_deep || nsvcd__is_deep(p, &contact);
  if (p->push.contact_count < NSVCD__TOUCHES) p->of.touches[p->push.contact_count++] = contact;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------ triangles/manifold
// In: triangle pairs that are near each other when a contact is. Out: up to four contact points
// that hold the body: those that span the largest area, seen along the contact's normal.
//
// Two triangles touch where a corner of one is over the other, or where two edges cross. Of all
// such points the farthest along eight directions are kept, for a slim contact those across it too,
// and of these the best four. Of two points equally far, the one with the lower number is kept: so
// the same points are chosen again when little has moved. Only normals close to the contact's
// count: where a side rises from the floor, corners of the floor's triangles are near the side as
// well, but the body does not stand on it.

#ifndef NSVCD_NO_PROOF
// A triangle pair of a manifold.
typedef struct nsvcd__facing {
  const nsvcd__triangle_pair *pair;
  const nsvcd__d3 *posed;  // the moving triangle
  // normals out of the fixed body; of an open surface on the side of the contact's
  nsvcd__d3 faces[2];
  int is_open;  // one is of an open surface
} nsvcd__facing;

static nsvcd__facing nsvcd__facing_of(const nsvcd__proof *p, nsvcd__d3 n,
                                      const nsvcd__triangle_pair *pair,
                                      const nsvcd__d3 *posed) {
  const int closed[2] = {nsvcd__moving_closed(p, pair), nsvcd__fixed_closed(p, pair)};
  nsvcd__facing out = {pair, posed, {{0, 0, 0}, {0, 0, 0}}, !closed[0] || !closed[1]};
  out.faces[0] = nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
  out.faces[1] = nsvcd__face_direction(pair->fixed);
  for (int k = 0; k < 2; k++) {
    nsvcd__d3 *face = &out.faces[k];
    const int turned = nsvcd__d3_dot(*face, n) < 0;
    if (turned && !closed[k]) *face = nsvcd__d3_scale(*face, -1);
  }
  return out;
}

// Does point x come apart along its normal, while one of its faces comes nearer? Then it is no
// contact, or one of another triangle pair.
static int nsvcd__is_left(const nsvcd__twist *twist, nsvcd__d3 x, nsvcd__d3 normal,
                          const nsvcd__d3 *faces) {
  const nsvcd__d3 speed = nsvcd__twist_of(twist, x);
  const double least = 1e-7 * nsvcd__d3_norm(speed);
  if (!(nsvcd__d3_dot(speed, normal) > least)) return 0;
  for (int k = 0; k < 2; k++)
    if (nsvcd__d3_dot(speed, faces[k]) < -least) return 1;
  return 0;
}

// Keeps a point where a triangle pair touches, if it is farther out than those kept. normal: of a
// face, or across two edges, of either sign.
static NSVCD__NOINLINE void nsvcd__keep_support(const nsvcd__proof *p, nsvcd__manifold *m,
                                                const nsvcd__facing *f, nsvcd__d3 on_moving,
                                                nsvcd__d3 on_fixed, nsvcd__d3 normal,
                                                uint32_t number) {
  const double side = nsvcd__d3_dot(normal, m->normal) < 0 ? -1 : 1;
  const nsvcd__d3 offset = nsvcd__d3_sub(on_moving, on_fixed);
  const double gap = side * nsvcd__d3_dot(offset, normal);
  const double aside = nsvcd__d3_dot(offset, offset) - gap * gap;
  nsvcd__d3 point;
  // Past the end of an edge they are not over each other.
  if (aside > 0.01 * m->same * m->same) return;
  // Nor are they on the far side of a sheet that they do not pass through.
  if (gap < 0 && f->is_open && !nsvcd__triangles_meet(f->posed, f->pair->fixed, &point))
    return;
  if (nsvcd__is_left(&m->twist, on_fixed, nsvcd__d3_scale(normal, side), f->faces)) return;
  nsvcd__nearest nearest = {gap > 0 ? gap * gap : 0, on_moving, on_fixed};
  nsvcd__pair_contact contact;
  int known = 0;
  for (int k = 0; k < NSVCD__SUPPORTS; k++) {
    const double along_it = nsvcd__d3_dot(m->along[k], on_fixed);
    const double more = along_it - m->farthest[k];
    if (!(more > m->same || (more >= -m->same && number < m->numbers[k]))) continue;
    if (!known) contact = nsvcd__contact_at(p, f->pair, 0, &nearest);
    known = 1;
    contact.normal = nsvcd__d3_scale(normal, side);
    m->supports[k] = contact;
    m->numbers[k] = number;
    m->farthest[k] = along_it;
  }
}

// Keeps all points where a triangle pair touches, within the tolerance. posed: the moving triangle.
// Corner k of entry e has the number 4 (3 e + k), and 1 more if it is of the fixed body.
static NSVCD__NOINLINE void nsvcd__collect_supports(const nsvcd__proof *p, nsvcd__manifold *m,
                                                    const nsvcd__triangle_pair *pair,
                                                    const nsvcd__d3 *posed) {
  const nsvcd__d3 *fixed = pair->fixed;
  nsvcd__d3 foot;
  int farther = 0;
  for (int k = 0; k < NSVCD__SUPPORTS && !farther; k++) {
    for (int i = 0; i < 3; i++)
      farther |=
          nsvcd__d3_dot(m->along[k], posed[i]) + m->tolerance >= m->farthest[k] - m->same;
  }
  if (!farther) return;
  // Faces must be about normal to the contact's.
  const nsvcd__facing facing = nsvcd__facing_of(p, m->normal, pair, posed);
  const int moving_faces = nsvcd__d3_dot(facing.faces[0], m->normal) >= 0.8;
  const int fixed_faces = nsvcd__d3_dot(facing.faces[1], m->normal) >= 0.8;
  for (size_t k = 0; k < 3; k++) {
    const uint32_t moving_id = (uint32_t)(3 * pair->moving_entry + k) << 2;
    const uint32_t fixed_id = (uint32_t)(3 * pair->fixed_entry + k) << 2 | 1;
    if (fixed_faces && nsvcd__foot_within(posed[k], fixed, &foot) &&
        nsvcd__d3_distance2(posed[k], foot) <= m->tolerance * m->tolerance)
      nsvcd__keep_support(p, m, &facing, posed[k], foot, facing.faces[1], moving_id);
    if (moving_faces && nsvcd__foot_within(fixed[k], posed, &foot) &&
        nsvcd__d3_distance2(fixed[k], foot) <= m->tolerance * m->tolerance)
      nsvcd__keep_support(p, m, &facing, foot, fixed[k], facing.faces[0], fixed_id);
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
      if (!(nearest.square <= m->tolerance * m->tolerance)) continue;
      const uint32_t number = moving_id * 3 + fixed_id * 5 + (uint32_t)(1 + i) * 0x9e3779b9u;
      nsvcd__keep_support(p, m, &facing, nearest.on_a, nearest.on_b,
                          nsvcd__d3_unit(across, facing.faces[1]), number | 2);
    }
  }
}

#endif  // NSVCD_NO_PROOF

// ======================================================== separate: until when surfaces stay apart

// ---------------------------------------------------------------------------------- separate/slabs
// In: patch pairs, a slice at a time. Out: those that no plane normal to a slab separates.

#ifndef NSVCD_NO_PROOF
// nsvcd__interval and nsvcd__deviation_of for a slice of directions, or for one direction in a
// slice of intervals.
typedef struct nsvcd__v_interval {
  nsvcd__v3 axis, heading;
  nsvcd__v rounding, origin_bend, bend, bend_along_axis, origin_along_axis, origin_off_heading;
} nsvcd__v_interval;

NSVCD__INLINE nsvcd__v_interval nsvcd__v_interval_set(const nsvcd__interval *over) {
  nsvcd__v_interval out;
  out.axis = nsvcd__v3_set(over->axis);
  out.heading = nsvcd__v3_set(over->heading);
  out.rounding = nsvcd__v_set(over->rounding);
  out.origin_bend = nsvcd__v_set(over->origin_bend);
  out.bend = nsvcd__v_set(over->bend);
  out.bend_along_axis = nsvcd__v_set(over->bend_along_axis);
  out.origin_along_axis = nsvcd__v_set(over->origin_along_axis);
  out.origin_off_heading = nsvcd__v_set(over->origin_off_heading);
  return out;
}
// A slice of a block, from lane l on.
NSVCD__INLINE nsvcd__v_interval nsvcd__v_interval_load(nsvcd__segments *block, size_t l) {
  nsvcd__v_interval out;
  out.axis = nsvcd__v3_load(block->axis, l);
  out.heading = nsvcd__v3_load(block->heading, l);
  out.rounding = nsvcd__v_load(block->rounding + l);
  out.origin_bend = nsvcd__v_load(block->origin_bend + l);
  out.bend = nsvcd__v_load(block->bend + l);
  out.bend_along_axis = nsvcd__v_load(block->bend_along_axis + l);
  out.origin_along_axis = nsvcd__v_load(block->origin_along_axis + l);
  out.origin_off_heading = nsvcd__v_load(block->origin_off_heading + l);
  return out;
}
NSVCD__INLINE nsvcd__v nsvcd__v_deviation(const nsvcd__v_interval *over, nsvcd__v3 n,
                                          float from_origin) {
  const nsvcd__v along = nsvcd__v_abs(nsvcd__v3_dot(n, over->axis));
  const nsvcd__v across = nsvcd__v3_norm(nsvcd__v3_cross(n, over->axis));
  const nsvcd__v ahead = nsvcd__v_abs(nsvcd__v3_dot(n, over->heading));
  const nsvcd__v aside = nsvcd__v3_norm(nsvcd__v3_cross(n, over->heading));
  nsvcd__v by_axis = nsvcd__v_mul(across, over->origin_bend);
  by_axis = nsvcd__v_fma(along, over->origin_along_axis, by_axis);
  nsvcd__v by_heading = nsvcd__v_mul(aside, over->origin_off_heading);
  by_heading = nsvcd__v_fma(ahead, over->origin_bend, by_heading);
  nsvcd__v turn = nsvcd__v_mul(across, over->bend);
  turn = nsvcd__v_fma(along, over->bend_along_axis, turn);
  return nsvcd__v_fma(turn, nsvcd__v_set(from_origin), nsvcd__v_min(by_axis, by_heading));
}

// A slice of slabs.
typedef struct nsvcd__v_slab {
  nsvcd__v3 normal;
  nsvcd__v low, high, across;
} nsvcd__v_slab;

NSVCD__INLINE nsvcd__v_slab nsvcd__v_slab_set(const nsvcd__slab *slab) {
  nsvcd__v_slab out;
  out.normal = nsvcd__v3_set(slab->normal);
  out.low = nsvcd__v_set(slab->low);
  out.high = nsvcd__v_set(slab->high);
  out.across = nsvcd__v_set(slab->across);
  return out;
}
// From (6, stride).
NSVCD__INLINE nsvcd__v_slab nsvcd__v_slab_load(const float *slabs, size_t stride) {
  nsvcd__v_slab out;
  out.normal = nsvcd__v3_get(slabs, stride);
  out.low = nsvcd__v_load(slabs + 3 * stride);
  out.high = nsvcd__v_load(slabs + 4 * stride);
  out.across = nsvcd__v_load(slabs + 5 * stride);
  return out;
}

// Extents of slabs, from their centres, along directions of these components: along the slabs'
// normals, and across them.
NSVCD__INLINE nsvcd__v_range nsvcd__v_slab_along(const nsvcd__v_slab *slab, nsvcd__v along,
                                                 nsvcd__v across) {
  const nsvcd__v a = nsvcd__v_mul(slab->low, along);
  const nsvcd__v b = nsvcd__v_mul(slab->high, along);
  const nsvcd__v side = nsvcd__v_mul(slab->across, across);
  nsvcd__v_range out;
  out.low = nsvcd__v_sub(nsvcd__v_min(a, b), side);
  out.high = nsvcd__v_add(nsvcd__v_max(a, b), side);
  return out;
}

// The same, along directions given in the slabs' own frame.
NSVCD__INLINE nsvcd__v_range nsvcd__v_slab_range(const nsvcd__v_slab *slab, nsvcd__v3 n) {
  const nsvcd__v along = nsvcd__v3_dot(n, slab->normal);
  const nsvcd__v across = nsvcd__v3_norm(nsvcd__v3_cross(n, slab->normal));
  return nsvcd__v_slab_along(slab, along, across);
}

// Moving slabs that approach fixed ones over an interval; either of them, and the interval, may
// be the same in all lanes.
typedef struct nsvcd__v_approach {
  // in its body's frame and units
  nsvcd__v_slab moving;
  nsvcd__v_slab fixed;
  // from the fixed centre to the moving one, and its travel
  nsvcd__v3 from, chord;
  // the fixed slab's normal in the moving body's frame, at both ends
  nsvcd__v3 at_start, at_end;
  // the mean of the moving slab's normals at both ends, and half their difference
  nsvcd__v3 mean, turned;
  // of the moving body
  nsvcd__v scale;
  nsvcd__v_interval over;
  float clearance;
  // of the moving slabs' points about their body's origin, in its units
  float radius;
  // nsvcd__v_off along the fixed slab's normal
  nsvcd__v fixed_off;
} nsvcd__v_approach;

// Along a plane's normal: the deviation of a moving point, and the clearance.
NSVCD__INLINE nsvcd__v nsvcd__v_off(const nsvcd__v_approach *a, nsvcd__v3 plane) {
  const nsvcd__v allowed = nsvcd__v_plus(a->over.rounding, a->clearance);
  return nsvcd__v_add(allowed, nsvcd__v_deviation(&a->over, plane, a->radius));
}

// Lanes that planes with this normal separate. start, end, fixed: the slabs' extents along it, the
// moving one's at both ends, each from its centre.
NSVCD__INLINE uint32_t nsvcd__v_separate(const nsvcd__v_approach *a, nsvcd__v3 plane,
                                         nsvcd__v_range start, nsvcd__v_range end,
                                         nsvcd__v_range fixed, nsvcd__v off) {
  const nsvcd__v height = nsvcd__v3_dot(plane, a->from);
  const nsvcd__v height_end = nsvcd__v_add(height, nsvcd__v3_dot(plane, a->chord));
  const nsvcd__v low =
      nsvcd__v_min(nsvcd__v_add(height, start.low), nsvcd__v_add(height_end, end.low));
  const nsvcd__v high =
      nsvcd__v_max(nsvcd__v_add(height, start.high), nsvcd__v_add(height_end, end.high));
  const uint32_t below = nsvcd__v_lt(high, nsvcd__v_sub(fixed.low, off));
  return below | nsvcd__v_lt(nsvcd__v_add(fixed.high, off), low);
}

// Lanes that planes with the fixed slabs' normals separate.
NSVCD__INLINE uint32_t nsvcd__v_separate_by_fixed(const nsvcd__v_approach *a) {
  const nsvcd__v_range fixed = {a->fixed.low, a->fixed.high};
  const nsvcd__v_range start = nsvcd__v_slab_range(&a->moving, a->at_start);
  const nsvcd__v_range end = nsvcd__v_slab_range(&a->moving, a->at_end);
  return nsvcd__v_separate(a, a->fixed.normal, start, end, fixed, a->fixed_off);
}

// Lanes that planes with normal w separate: the mean of the moving slabs' normals, |w| <= 1. Both
// normals make the same angle with w: they are |w|^2 along it and no more than |turned| across it.
NSVCD__INLINE uint32_t nsvcd__v_separate_by_moving(const nsvcd__v_approach *a) {
  const nsvcd__v3 w = a->mean;
  const nsvcd__v along = nsvcd__v_mul(a->scale, nsvcd__v3_dot(w, w));
  const nsvcd__v across = nsvcd__v_mul(a->scale, nsvcd__v3_norm(a->turned));
  const nsvcd__v_range moving = nsvcd__v_slab_along(&a->moving, along, across);
  const nsvcd__v_range fixed = nsvcd__v_slab_range(&a->fixed, w);
  return nsvcd__v_separate(a, w, moving, moving, fixed, nsvcd__v_off(a, w));
}

// Of the lanes `met` of moving group g in segment s, those that slabs do not separate from fixed
// patch j.
static uint32_t nsvcd__slabs_meet(const nsvcd__proof *p, const nsvcd__interval *over,
                                  const nsvcd__search *q, size_t g, size_t j, size_t s,
                                  uint32_t met) {
  const nsvcd__chords *c = &q->members[s];
  const nsvcd__slab fixed = nsvcd__slab_at(p->fixed.slabs, p->fixed.body->padded, j);
  const nsvcd__f3 centre = nsvcd__patch_centre(&p->fixed, j);
  const nsvcd__mat3 *from = &over->start.rotation;
  const nsvcd__mat3 *to = &over->end.rotation;
  uint32_t left = 0;
  nsvcd__v_approach a;
  a.fixed = nsvcd__v_slab_set(&fixed);
  a.at_start = nsvcd__v3_set(nsvcd__mat3_apply_transpose(from, fixed.normal));
  a.at_end = nsvcd__v3_set(nsvcd__mat3_apply_transpose(to, fixed.normal));
  a.scale = nsvcd__v_set(p->arcs.motion->scale);
  a.over = nsvcd__v_interval_set(over);
  a.clearance = nsvcd__clearance(&p->goal);
  a.radius = q->extent;
  a.fixed_off = nsvcd__v_off(&a, a.fixed.normal);
  NSVCD__EACH_SLICE(l) {
    const size_t i = NSVCD__GROUP * g + l;
    uint32_t wanted = met >> l & NSVCD__SLICE_MASK;
    if (!wanted) continue;
    a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
    a.chord = nsvcd__chords_travel(c, l);
    a.moving = nsvcd__v_slab_load(p->moving.slabs + i, p->moving.body->padded);
    wanted &= ~nsvcd__v_separate_by_fixed(&a);
    if (!wanted) continue;
    // rotations in an interval are times the scale
    const float half = 0.5f * p->arcs.motion->per_scale;
    const nsvcd__mat3 middle = nsvcd__mat3_mix(half, to, 1, from);
    const nsvcd__mat3 half_turn = nsvcd__mat3_mix(half, to, -1, from);
    a.mean = nsvcd__vmat3_apply(nsvcd__vmat3_set(&middle), a.moving.normal);
    a.turned = nsvcd__vmat3_apply(nsvcd__vmat3_set(&half_turn), a.moving.normal);
    left |= (wanted & ~nsvcd__v_separate_by_moving(&a)) << l;
  }
  return left;
}

// Clears the segments in which slabs separate the moving group that is searched, whose chords are
// in q->group, from the fixed ones that it meets: a slice of segments at a time.
static NSVCD__NOINLINE void nsvcd__separate_groups(const nsvcd__proof *p, nsvcd__search *q) {
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const size_t next = q->order[q->step];
  const size_t g = q->moving_tile.groups[next];
  const nsvcd__slab own =
      nsvcd__slab_at(p->moving.group_slabs, nsvcd__group_slots(moving->padded), g);
  nsvcd__v_approach a;
  a.moving = nsvcd__v_slab_set(&own);
  a.scale = nsvcd__v_set(q->scale);
  a.clearance = nsvcd__clearance(&p->goal);
  a.radius = nsvcd__group_extent(moving, g);
  for (uint32_t waiting = q->waiting; waiting; waiting &= waiting - 1) {
    const size_t at = nsvcd__low_bit(waiting);
    const size_t h = q->fixed_tile.groups[at];
    const nsvcd__slab other =
        nsvcd__slab_at(p->fixed.group_slabs, nsvcd__group_slots(fixed->padded), h);
    const nsvcd__f3 centre = nsvcd__centre_of(nsvcd__groups_of(fixed), h);
    uint64_t *met = &nsvcd__nearby(q, next)[at];
    a.fixed = nsvcd__v_slab_set(&other);
    for (size_t first = 0; first < NSVCD__MAX_SEGMENTS; first += NSVCD__SLICE) {
      const uint32_t wanted = (uint32_t)(*met >> first) & NSVCD__SLICE_MASK;
      nsvcd__segments *block = &q->blocks[first / NSVCD__LANES];
      const nsvcd__chords *c = &q->group[first / NSVCD__LANES];
      const size_t l = first % NSVCD__LANES;
      if (!wanted) continue;
      const nsvcd__vmat3 rotation = nsvcd__vmat3_load(block->rotation, l);
      const nsvcd__vmat3 turn = nsvcd__vmat3_load(block->turned, l);
      const nsvcd__v half = nsvcd__v_set(0.5f / q->scale);
      const nsvcd__v whole = nsvcd__v_set(1 / q->scale);
      const nsvcd__v3 n = a.fixed.normal;
      const nsvcd__v3 m = a.moving.normal;
      a.over = nsvcd__v_interval_load(block, l);
      a.fixed_off = nsvcd__v_off(&a, n);
      a.from = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
      a.chord = nsvcd__chords_travel(c, l);
      a.at_start = nsvcd__vmat3_apply_transpose(rotation, n);
      a.at_end = nsvcd__v3_add(a.at_start, nsvcd__vmat3_apply_transpose(turn, n));
      a.turned = nsvcd__v3_scale(nsvcd__vmat3_apply(turn, m), half);
      a.mean = nsvcd__v3_fma(whole, nsvcd__vmat3_apply(rotation, m), a.turned);
      const uint32_t apart = nsvcd__v_separate_by_fixed(&a) | nsvcd__v_separate_by_moving(&a);
      *met &= ~((uint64_t)(apart & wanted) << first);
    }
    if (!*met) q->waiting &= ~((uint32_t)1 << at);
  }
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------------- separate/hulls
// In: a patch pair and an interval. Out: is there a plane between the two hulls over all of the
// interval?

#ifndef NSVCD_NO_PROOF
// A slice, from lane l on, of a patch's hull, in its body's frame and units. Lanes without a vertex
// repeat the last one.
NSVCD__INLINE nsvcd__v3 nsvcd__hull_of(const nsvcd__geometry *f, size_t patch, size_t l) {
  static const float lane[NSVCD__LANES] = {0, 1, 2,  3,  4,  5,  6,  7,
                                           8, 9, 10, 11, 12, 13, 14, 15};
  const nsvcd__vertices all = nsvcd__vertices_of(f, patch);
  const size_t count = f->hull_counts[patch];
  nsvcd__v3 q;
  q.x = nsvcd__v_load_int16(all.x + l);
  q.y = nsvcd__v_load_int16(all.y + l);
  q.z = nsvcd__v_load_int16(all.z + l);
  if (count < l + NSVCD__SLICE) {
    const size_t last = count - 1;
    const nsvcd__v end = nsvcd__v_set((float)last);
    const nsvcd__v index = nsvcd__v_load(lane + l);
    q.x = nsvcd__v_pick(index, end, q.x, nsvcd__v_set((float)all.x[last]));
    q.y = nsvcd__v_pick(index, end, q.y, nsvcd__v_set((float)all.y[last]));
    q.z = nsvcd__v_pick(index, end, q.z, nsvcd__v_set((float)all.z[last]));
  }
  const nsvcd__v step = nsvcd__v_set(f->steps[patch]);
  return nsvcd__v3_fma(step, q, nsvcd__v3_set(nsvcd__patch_centre(f, patch)));
}

// The least of a number and a slice. A NaN stays: it separates nothing.
NSVCD__INLINE float nsvcd__least_of(float least, nsvcd__v slice) {
  const float other = nsvcd__v_least(slice);
  return least < other || least != least ? least : other;
}

// The greatest of a number and a slice. A NaN stays.
NSVCD__INLINE float nsvcd__greatest_of(float greatest, nsvcd__v slice) {
  return -nsvcd__least_of(-greatest, nsvcd__v_negate(slice));
}

// The gap between two posed hulls along a direction, the moving one at both ends of the interval,
// and the difference of the two vertices that bound it.
typedef struct nsvcd__support {
  float gap;
  nsvcd__f3 difference;
} nsvcd__support;

NSVCD__INLINE nsvcd__support nsvcd__support_along(nsvcd__solver *w, nsvcd__f3 normal) {
  float moving[NSVCD__LANES], fixed[NSVCD__LANES];  // heights
  float lowest = HUGE_VALF;
  float highest = -HUGE_VALF;
  uint32_t starts = 0;  // lanes that are lower at the start
  uint32_t low = 0;
  uint32_t high = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 n = nsvcd__v3_set(normal);
    const nsvcd__v at_start = nsvcd__v3_dot(n, nsvcd__v3_load(w->hull_start, l));
    const nsvcd__v at_end = nsvcd__v3_dot(n, nsvcd__v3_load(w->hull_end, l));
    const nsvcd__v height = nsvcd__v3_dot(n, nsvcd__v3_load(w->hull_fixed, l));
    const nsvcd__v at_either = nsvcd__v_min(at_start, at_end);
    nsvcd__v_store(moving + l, at_either);
    nsvcd__v_store(fixed + l, height);
    lowest = nsvcd__least_of(lowest, at_either);
    highest = nsvcd__greatest_of(highest, height);
    starts |= nsvcd__v_le(at_start, at_end) << l;
  }
  NSVCD__EACH_SLICE(l) {
    low |= nsvcd__v_le(nsvcd__v_load(moving + l), nsvcd__v_set(lowest)) << l;
    high |= nsvcd__v_le(nsvcd__v_set(highest), nsvcd__v_load(fixed + l)) << l;
  }
  // a NaN compares with no lane: then the last one
  const size_t a = nsvcd__low_bit(low | 0x8000);
  const size_t b = nsvcd__low_bit(high | 0x8000);
  const int is_start = (starts >> a & 1) != 0;
  const nsvcd__f3 vertex = nsvcd__lane_of(is_start ? w->hull_start : w->hull_end, a);
  const nsvcd__f3 other = nsvcd__lane_of(w->hull_fixed, b);
  const nsvcd__support out = {lowest - highest, nsvcd__f3_sub(vertex, other)};
  return out;
}

// a or -a, on the side of b.
static nsvcd__f3 nsvcd__f3_towards(nsvcd__f3 a, nsvcd__f3 b) {
  return nsvcd__f3_scale(a, nsvcd__f3_dot(a, b) < 0 ? -1.0f : 1.0f);
}

// Is there a plane between two patches over the whole interval? A direction separates them if the
// gap between the hulls along it is more than the margin and the deviation. First guesses: the last
// plane that held, the slabs' normals, the line of centres. Then Gilbert's iteration (1966) from
// there towards the point nearest to 0 of the difference of the two hulls.
// Remembers the plane that holds.
#define NSVCD__GUESSES 4
static NSVCD__NOINLINE int nsvcd__hulls_are_apart(nsvcd__solver *w, size_t i, size_t j,
                                                  const nsvcd__interval *over) {
  nsvcd__proof *p = &w->p;
  const nsvcd__geometry *f = &p->moving;
  const nsvcd__geometry *g = &p->fixed;
  const float margins = p->arcs.motion->scale * f->margins[i] + g->margins[j];
  const float margin = margins + over->rounding + nsvcd__clearance(&p->goal);
  const nsvcd__arm arm = nsvcd__patch_arm(f, i, over);
  const nsvcd__transform *start = &over->start;
  const nsvcd__transform *end = &over->end;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 hull = nsvcd__hull_of(f, i, l);
    nsvcd__v3_store(w->hull_start, l, nsvcd__v3_transform(start, hull));
    nsvcd__v3_store(w->hull_end, l, nsvcd__v3_transform(end, hull));
    nsvcd__v3_store(w->hull_fixed, l, nsvcd__hull_of(g, j, l));
  }
  const nsvcd__slab moving = nsvcd__slab_at(f->slabs, f->body->padded, i);
  const nsvcd__slab fixed = nsvcd__slab_at(g->slabs, g->body->padded, j);
  const nsvcd__f3 centre = nsvcd__patch_centre(f, i);
  const nsvcd__f3 both =
      nsvcd__f3_add(nsvcd__f3_transform(start, centre), nsvcd__f3_transform(end, centre));
  const nsvcd__f3 middle = nsvcd__f3_scale(both, 0.5f);
  const nsvcd__f3 line = nsvcd__f3_sub(middle, nsvcd__patch_centre(g, j));
  const nsvcd__f3 turned = nsvcd__mat3_apply(&start->rotation, moving.normal);
  const nsvcd__f3 guesses[NSVCD__GUESSES] = {w->memo.held,
                                             nsvcd__f3_towards(fixed.normal, line),
                                             nsvcd__f3_towards(turned, line), line};
  nsvcd__f3 nearest = {0, 0, 0};
  p->work++;
  for (size_t step = 0; step < NSVCD__GUESSES + NSVCD__PLANE_STEPS; step++) {
    const nsvcd__f3 normal = step < NSVCD__GUESSES ? guesses[step] : nearest;
    const nsvcd__support found = nsvcd__support_along(w, normal);
    const float length = nsvcd__f3_norm(normal);
    if (found.gap > 0 &&
        found.gap > margin * length + nsvcd__deviation_of(over, normal, arm)) {
      w->memo.held = normal;
      w->memo.plane++;
      return 1;
    }
    if (step + 1 < NSVCD__GUESSES) continue;
    const nsvcd__f3 toward = nsvcd__f3_sub(found.difference, nearest);
    const float square = nsvcd__f3_dot(toward, toward);
    float fraction = square > 0 ? -nsvcd__f3_dot(nearest, toward) / square : 0;
    fraction = fraction > 0 ? fminf(fraction, 1) : 0;
    const nsvcd__f3 nearer = nsvcd__f3_add(nearest, nsvcd__f3_scale(toward, fraction));
    nearest = step < NSVCD__GUESSES ? found.difference : nearer;
    // the hulls come this near
    if (nsvcd__f3_dot(nearest, nearest) <= margin * margin) return 0;
  }
  return 0;
}

// Does the plane that held last separate a patch pair over its segment, moved along its normal? If
// it does, the pair's neighbours ask for the same heights: so these are remembered, of a moving
// patch in a segment the least, less all margins, and of a fixed one the greatest.
static int nsvcd__held_again(nsvcd__solver *w, const nsvcd__search *q,
                             const nsvcd__patch_pair *patches) {
  nsvcd__proof *p = &w->p;
  const size_t i = patches->moving;
  const size_t j = patches->fixed;
  const size_t s = patches->segment;
  const nsvcd__geometry *f = &p->moving;
  const nsvcd__geometry *g = &p->fixed;
  nsvcd__memo *memo = &w->memo;
  if (!memo->plane) return 0;
  const nsvcd__interval *over = nsvcd__segment_interval(w, q, s);
  const nsvcd__f3 n = memo->held;
  const float length = nsvcd__f3_norm(n);
  const uint32_t key = (uint32_t)(i * NSVCD__MAX_SEGMENTS + s);
  nsvcd__height *above =
      &memo->heights[(NSVCD__GROUP * s + i % NSVCD__GROUP) % NSVCD__HEIGHTS];
  nsvcd__height *below = &memo->fixed_heights[j % NSVCD__FIXED_HEIGHTS];
  if (above->plane != memo->plane || above->key != key) {
    float lowest = HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 hull = nsvcd__hull_of(f, i, l);
      const nsvcd__v3 normal = nsvcd__v3_set(n);
      const nsvcd__v at_start = nsvcd__v3_dot(normal, nsvcd__v3_transform(&over->start, hull));
      const nsvcd__v at_end = nsvcd__v3_dot(normal, nsvcd__v3_transform(&over->end, hull));
      lowest = nsvcd__least_of(lowest, nsvcd__v_min(at_start, at_end));
    }
    const float margin = (p->arcs.motion->scale * f->margins[i] + over->rounding) * length;
    above->plane = memo->plane;
    above->key = key;
    above->height =
        lowest - margin - nsvcd__deviation_of(over, n, nsvcd__patch_arm(f, i, over));
  }
  if (below->plane != memo->plane || below->key != j) {
    float highest = -HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v height = nsvcd__v3_dot(nsvcd__v3_set(n), nsvcd__hull_of(g, j, l));
      highest = nsvcd__greatest_of(highest, height);
    }
    below->plane = memo->plane;
    below->key = (uint32_t)j;
    below->height = g->margins[j] * length + highest;
  }
  return above->height > below->height + nsvcd__clearance(&p->goal) * length;
}
#endif  // NSVCD_NO_PROOF

// --------------------------------------------------------------------------------- separate/blocks
// In: 16 triangles of a patch, and a plane or other triangles. Out: which of them may meet.

#ifndef NSVCD_NO_PROOF
// Loads entries first .. first + count - 1 of a patch, at most 16; the last one is repeated. Stored
// points are off by no more than a quantization error, and what NSVCD__ROUNDING allows.
static void nsvcd__block_load(const nsvcd__geometry *f, size_t patch, size_t first,
                              size_t count, nsvcd__block *out) {
  const nsvcd__patch_points points = nsvcd__points_of(f, patch);
  const nsvcd__vertices stored = nsvcd__vertices_of(f, patch);
  const nsvcd__f3 centre = nsvcd__patch_centre(f, patch);
  const float step = f->steps[patch];
  const size_t bytes = nsvcd__corner_bytes(points.all);
  const unsigned char *codes =
      f->entries + f->first_byte[patch] + 3 * bytes * (first - f->first_triangle[patch]);
  out->patch = patch;
  out->first = first;
  out->count = count;
  for (size_t k = 0; k < 3; k++) {
    float(*to)[NSVCD__LANES] = out->corners[k];
    for (size_t l = 0; l < count; l++) {
      const size_t n = 3 * l + k;
      uint16_t i = codes[n];
      if (bytes == 2) memcpy(&i, codes + 2 * n, sizeof i);
      if (i < points.stored) {
        to[0][l] = centre.x + step * (float)stored.x[i];
        to[1][l] = centre.y + step * (float)stored.y[i];
        to[2][l] = centre.z + step * (float)stored.z[i];
        continue;
      }
      const float *position = nsvcd__position_of(f, patch, points, i);
      nsvcd__lane_set(nsvcd__f3_load(position), to, l);
    }
    for (size_t l = count; l < NSVCD__LANES; l++)
      nsvcd__lane_set(nsvcd__lane_of(to, count - 1), to, l);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 a = nsvcd__v3_load(out->corners[0], l);
    const nsvcd__v3 b = nsvcd__v3_load(out->corners[1], l);
    const nsvcd__v3 c = nsvcd__v3_load(out->corners[2], l);
    nsvcd__v3_store(out->low, l, nsvcd__v3_min(nsvcd__v3_min(a, b), c));
    nsvcd__v3_store(out->high, l, nsvcd__v3_max(nsvcd__v3_max(a, b), c));
  }
}

// Poses the corners of the moving block at both ends of an interval, and replaces its boxes by
// those of the posed corners. Without an interval, NULL: at the pose `at` alone.
static NSVCD__NOINLINE void nsvcd__block_pose(nsvcd__blocks *b, const nsvcd__transform *at,
                                              const nsvcd__interval *over) {
  b->over = over;
  b->corner_count = over ? 6 : 3;
  NSVCD__EACH_SLICE(l) {
    nsvcd__v3 low = nsvcd__v3_set(nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF));
    nsvcd__v3 high = nsvcd__v3_negate(low);
    for (size_t k = 0; k < b->corner_count; k++) {
      const nsvcd__v3 own = nsvcd__v3_load(b->moving.corners[k % 3], l);
      const nsvcd__transform *pose = !over ? at : k < 3 ? &over->start : &over->end;
      const nsvcd__v3 corner = nsvcd__v3_transform(pose, own);
      nsvcd__v3_store(b->corners[k], l, corner);
      low = nsvcd__v3_min(low, corner);
      high = nsvcd__v3_max(high, corner);
    }
    nsvcd__v3_store(b->moving.low, l, low);
    nsvcd__v3_store(b->moving.high, l, high);
  }
}

// Of the moving block's corners. axis: unit, as the body has it.
static nsvcd__arm nsvcd__block_arm(nsvcd__block *block, nsvcd__f3 axis, float error) {
  nsvcd__v farthest = nsvcd__v_set(0);  // squares
  nsvcd__v aside = farthest;
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 corner = nsvcd__v3_load(block->corners[k], l);
      const nsvcd__v3 across = nsvcd__v3_cross(corner, nsvcd__v3_set(axis));
      farthest = nsvcd__v_max(farthest, nsvcd__v3_dot(corner, corner));
      aside = nsvcd__v_max(aside, nsvcd__v3_dot(across, across));
    }
  }
  const float from_origin = 1.00001f * sqrtf(nsvcd__greatest_of(0, farthest)) + error;
  const float from_axis = 1.00001f * sqrtf(nsvcd__greatest_of(0, aside)) + error;
  const nsvcd__arm out = {from_origin, from_axis + 1e-6f * from_origin};
  return out;
}

// The box about a block's boxes.
static nsvcd__box nsvcd__block_bounds(const nsvcd__block *block) {
  float low[3], high[3];
  for (size_t k = 0; k < 3; k++) {
    low[k] = HUGE_VALF;
    high[k] = -HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      low[k] = nsvcd__least_of(low[k], nsvcd__v_load(block->low[k] + l));
      high[k] = nsvcd__greatest_of(high[k], nsvcd__v_load(block->high[k] + l));
    }
  }
  const nsvcd__box out = {nsvcd__f3_load(low), nsvcd__f3_load(high)};
  return out;
}

// Loads up to NSVCD__WINDOW blocks of fixed patch j, from entry `first` on, and the boxes about
// them. The same patch is often asked for again.
static void nsvcd__window_load(nsvcd__blocks *b, const nsvcd__geometry *f, size_t j,
                               size_t first) {
  const size_t end = f->first_triangle[j + 1];
  if (b->window > 0 && b->fixed[0].first == first) return;
  b->window = 0;
  for (size_t n = first; n < end && b->window < NSVCD__WINDOW; n += NSVCD__LANES) {
    nsvcd__block *block = &b->fixed[b->window];
    nsvcd__block_load(f, j, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
    b->bounds[b->window++] = nsvcd__block_bounds(block);
  }
}

// The lanes of a block that are entries of their own.
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

// Normals of planes that may separate two triangles: the one that separated a triangle pair last;
// those of both; and of an edge of each.
#define NSVCD__LAST_NORMAL 0
#define NSVCD__NORMALS 12

// Normal k, of any length, for lane l of the moving block and a slice, from s on, of a fixed one. A
// moving edge without length, of a point or a segment: its corner's travel counts instead.
NSVCD__INLINE nsvcd__v3 nsvcd__normal_to_try(nsvcd__solver *w, size_t l, nsvcd__block *fixed,
                                             size_t s, size_t k) {
  if (k == NSVCD__LAST_NORMAL) return nsvcd__v3_set(nsvcd__f3_round(w->p.separating));
  if (k == 1) {
    const nsvcd__v3 b = nsvcd__v3_load(fixed->corners[0], s);
    const nsvcd__v3 u = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[1], s), b);
    const nsvcd__v3 v = nsvcd__v3_sub(nsvcd__v3_load(fixed->corners[2], s), b);
    return nsvcd__v3_cross(u, v);
  }
  if (k == 2) {
    const nsvcd__f3 a = nsvcd__lane_of(w->blocks.corners[0], l);
    const nsvcd__f3 u = nsvcd__f3_sub(nsvcd__lane_of(w->blocks.corners[1], l), a);
    const nsvcd__f3 v = nsvcd__f3_sub(nsvcd__lane_of(w->blocks.corners[2], l), a);
    return nsvcd__v3_set(nsvcd__f3_cross(u, v));
  }
  const size_t of_moving = k / 3 - 1;
  const size_t of_fixed = k % 3;
  const nsvcd__v3 b = nsvcd__v3_load(fixed->corners[of_fixed], s);
  const nsvcd__v3 b_next = nsvcd__v3_load(fixed->corners[(of_fixed + 1) % 3], s);
  const nsvcd__f3 a = nsvcd__lane_of(w->blocks.corners[of_moving], l);
  const nsvcd__f3 a_next = nsvcd__lane_of(w->blocks.corners[(of_moving + 1) % 3], l);
  nsvcd__f3 edge = nsvcd__f3_sub(a_next, a);
  if (w->blocks.over && !(nsvcd__f3_dot(edge, edge) > 0))
    edge = nsvcd__f3_sub(nsvcd__lane_of(w->blocks.corners[3 + of_moving], l), a);
  return nsvcd__v3_cross(nsvcd__v3_set(edge), nsvcd__v3_sub(b_next, b));
}

// Lanes of a slice, from s on, of a fixed block that planes with these normals, of any length,
// separate from lane l of the moving one, as posed, by more than `margin`.
NSVCD__INLINE uint32_t nsvcd__normals_separate(nsvcd__blocks *b, size_t l, nsvcd__block *fixed,
                                               size_t s, float margin, nsvcd__v3 n) {
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
  for (size_t k = 0; k < b->corner_count; k++) {
    const nsvcd__v3 a = nsvcd__v3_set(nsvcd__lane_of(b->corners[k], l));
    const nsvcd__v height = nsvcd__v3_dot(n, nsvcd__v3_sub(a, b0));
    lowest = nsvcd__v_min(lowest, height);
    highest = nsvcd__v_max(highest, height);
  }
  // where the normal's square underflows, nothing is beyond the limit
  const nsvcd__v square = nsvcd__v3_dot(n, n);
  nsvcd__v limit = nsvcd__v_scale(nsvcd__v_sqrt(square), margin);
  limit = nsvcd__v_pick(square, nsvcd__v_set(1e-30f), nsvcd__v_set(1e30f), limit);
  const uint32_t below = nsvcd__v_lt(highest, nsvcd__v_sub(low, limit));
  return nsvcd__v_lt(nsvcd__v_add(high, limit), lowest) | below;
}

// Of these lanes of a fixed block, those that planes with normal k do not separate from lane l of
// the moving one by more than `margin`.
NSVCD__INLINE uint32_t nsvcd__left_by_normal(nsvcd__solver *w, size_t l, nsvcd__block *fixed,
                                             size_t k, float margin, uint32_t met) {
  NSVCD__EACH_SLICE(s) {
    if (!(met >> s & NSVCD__SLICE_MASK)) continue;
    const nsvcd__v3 normal = nsvcd__normal_to_try(w, l, fixed, s, k);
    met &= ~(nsvcd__normals_separate(&w->blocks, l, fixed, s, margin, normal) << s);
  }
  return met;
}

// Of these lanes of the moving block, those that the plane which separated a triangle pair last
// does not separate from all of a fixed block by more than `margin`. Tried where there is a
// clearance: then near triangles have their nearest points along nearly the same direction.
static NSVCD__NOINLINE uint32_t nsvcd__lanes_left_by_last(nsvcd__solver *w,
                                                          nsvcd__block *fixed, float margin,
                                                          uint32_t lanes) {
  nsvcd__proof *p = &w->p;
  const nsvcd__f3 last = nsvcd__f3_round(p->separating);
  const nsvcd__v3 normal = nsvcd__v3_set(last);
  if (!(p->goal.clearance > 0) || !lanes) return lanes;
  float highest = -HUGE_VALF;  // of the fixed block
  for (size_t k = 0; k < 3; k++) {
    NSVCD__EACH_SLICE(s) {
      const nsvcd__v3 corner = nsvcd__v3_load(fixed->corners[k], s);
      highest = nsvcd__greatest_of(highest, nsvcd__v3_dot(normal, corner));
    }
  }
  const nsvcd__v limit = nsvcd__v_set(margin * nsvcd__f3_norm(last) + highest);
  uint32_t apart = 0;
  NSVCD__EACH_SLICE(s) {
    nsvcd__v height = nsvcd__v_set(HUGE_VALF);
    for (size_t k = 0; k < w->blocks.corner_count; k++) {
      const nsvcd__v3 corner = nsvcd__v3_load(w->blocks.corners[k], s);
      height = nsvcd__v_min(height, nsvcd__v3_dot(normal, corner));
    }
    apart |= nsvcd__v_lt(limit, height) << s;
  }
  return lanes & ~apart;
}

// Lanes of a fixed block that neither boxes nor planes separate from lane l of the moving one.
static NSVCD__NOINLINE uint32_t nsvcd__row_left(nsvcd__solver *w, size_t l,
                                                nsvcd__block *fixed, float margin) {
  nsvcd__block *block = &w->blocks.moving;
  const nsvcd__box box = {nsvcd__lane_of(block->low, l), nsvcd__lane_of(block->high, l)};
  uint32_t met = nsvcd__lanes_near(fixed, box, margin);
  // the last plane: see nsvcd__lanes_left_by_last
  for (size_t k = w->p.goal.clearance > 0 ? NSVCD__LAST_NORMAL : 1; met && k < NSVCD__NORMALS;
       k++)
    met = nsvcd__left_by_normal(w, l, fixed, k, margin, met);
  return met;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------ separate/witnesses
// In: a patch pair and a time. Out: a contact: two triangles that meet then, or come within the
// clearance; with a slop, what touches at the start and which directions undo it.

#ifndef NSVCD_NO_PROOF
// Seeks a contact of the moving block, posed `at`, and block n of the window, at fraction u of the
// arc.
static nsvcd__outcome nsvcd__find_witness_in(nsvcd__solver *w, size_t i, size_t j, size_t n,
                                             const nsvcd__dtransform *at, double u,
                                             float margin) {
  nsvcd__proof *p = &w->p;
  nsvcd__block *fixed = &w->blocks.fixed[n];
  const double clearance = p->goal.clearance;
  const uint32_t nearby = nsvcd__lanes_near(&w->blocks.moving, w->blocks.bounds[n], margin);
  uint32_t lanes = nsvcd__lanes_left_by_last(w, fixed, margin, nearby);
  for (; lanes; lanes &= lanes - 1) {
    const size_t l = nsvcd__low_bit(lanes);
    p->work++;
    uint32_t met = nsvcd__row_left(w, l, fixed, margin);
    for (; met; met &= met - 1) {
      if (clearance > 0)
        met = nsvcd__left_by_normal(w, l, fixed, NSVCD__LAST_NORMAL, margin, met);
      if (!met) break;
      const size_t entry = w->blocks.moving.first + l;
      const nsvcd__triangle_pair pair =
          nsvcd__pair_of(p, i, j, entry, fixed->first + nsvcd__low_bit(met));
      nsvcd__d3 posed[3];
      nsvcd__nearest nearest = {0, {0, 0, 0}, {0, 0, 0}};
      nsvcd__pose_triangle(at, pair.moving, posed);
      p->work++;
      if (p->goal.collects == NSVCD__SUPPORTING) {
        nsvcd__collect_supports(p, &p->of.kept.manifold, &pair, posed);
        continue;
      }
      if (nsvcd__triangles_meet(posed, pair.fixed, &nearest.on_b)) {
        nearest.on_a = nearest.on_b;
      } else {
        if (!(clearance > 0)) continue;
        nearest = nsvcd__nearest_of(posed, pair.fixed);
        if (!(nearest.square <= clearance * clearance)) {
          const nsvcd__d3 distance = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
          p->separating = nsvcd__d3_scale(distance, 1 / sqrt(nearest.square));
          continue;
        }
      }
      if (p->goal.collects == NSVCD__TOUCHING) {
        nsvcd__collect_contact(p, &pair, posed);
        continue;
      }
      const nsvcd__outcome contact = nsvcd__take_contact(p, &pair, u, &nearest);
      if (contact == NSVCD__ANSWERED) return contact;
      // They may touch sooner, or come closer.
      const nsvcd__outcome better = nsvcd__resolve_pair(p, &pair, 0, 1);
      return better == NSVCD__ANSWERED ? better : contact;
    }
  }
  return NSVCD__NOTHING;
}

// Loads 16 triangles of moving patch i, from entry `first` on. They are often loaded already.
static void nsvcd__moving_block_load(nsvcd__blocks *b, const nsvcd__geometry *f, size_t i,
                                     size_t first) {
  const size_t left = f->first_triangle[i + 1] - first;
  if (b->has_block && b->moving.first == first) return;
  b->has_block = 1;
  nsvcd__block_load(f, i, first, left < NSVCD__LANES ? left : NSVCD__LANES, &b->moving);
}

// Seeks a contact of triangles of patches i and j at fraction u of an arc.
static nsvcd__outcome nsvcd__find_witness(nsvcd__solver *w, size_t i, size_t j, uint32_t first,
                                          double u) {
  nsvcd__proof *p = &w->p;
  const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, first);
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, u);
  const nsvcd__transform rounded = nsvcd__transform_of(&at);
  const float lengths = p->given.lengths + nsvcd__f3_norm(rounded.position);
  const float margin =
      NSVCD__ROUNDING * lengths + nsvcd__clearance(&p->goal) + nsvcd__errors_of(p, i, j);
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  for (size_t b = p->fixed.first_triangle[j]; b < fixed_end;
       b += NSVCD__WINDOW * NSVCD__LANES) {
    nsvcd__window_load(&w->blocks, &p->fixed, j, b);
    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {
      nsvcd__moving_block_load(&w->blocks, &p->moving, i, a);
      nsvcd__block_pose(&w->blocks, &rounded, NULL);
      for (size_t n = 0; n < w->blocks.window; n++) {
        p->work++;
        if (nsvcd__check_budget(p)) return NSVCD__NOTHING;
        const nsvcd__outcome found = nsvcd__find_witness_in(w, i, j, n, &at, u, margin);
        if (found != NSVCD__NOTHING) return found;
      }
    }
  }
  return NSVCD__NOTHING;
}

// The keyframe at which the arc of a time in ticks begins, the last one that is not after it; and
// how much of the arc has gone by.
static uint32_t nsvcd__arc_of(const nsvcd__motion *m, double time, double *fraction) {
  const uint32_t last = m->ticks - 1;
  const uint32_t tick = time < (double)last ? (uint32_t)time : last;
  const uint32_t a = nsvcd__tick_of(&m->moving, nsvcd__pose_before(&m->moving, tick));
  const uint32_t b = nsvcd__tick_of(&m->fixed, nsvcd__pose_before(&m->fixed, tick));
  const uint32_t first = a > b ? a : b;
  *fraction = (time - (double)first) / (double)(nsvcd__next_keyframe(m, first) - first);
  return first;
}

// Seeks a contact of a patch pair when its spheres are nearest, if that still matters.
static nsvcd__outcome nsvcd__seek_in_patch_pair(nsvcd__solver *w, const nsvcd__search *q,
                                                nsvcd__patch_pair *pair) {
  nsvcd__proof *p = &w->p;
  const double start = (double)q->begin[pair->segment];
  const double end = nsvcd__min((double)q->begin[pair->segment + 1u], w->clipped_end);
  const double tick = start + (double)pair->fraction * (end - start);
  double u;
  pair->sought = 1;
  if (!(tick < p->known.end)) return NSVCD__NOTHING;
  const uint32_t first = nsvcd__arc_of(p->arcs.motion, tick, &u);
  return nsvcd__find_witness(w, pair->moving, pair->fixed, first, u);
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------- separate/patch_pairs
// In: fresh patch pairs, as the search finds them. Out: each is separated, by a plane between its
// hulls or by its triangles, or in contact, or kept as an unresolved pair.

#ifndef NSVCD_NO_PROOF
// Does the plane that separated a triangle pair last separate all of patches i and j from u0 to u1
// of the arc, in double? Where flat lies on flat, nearer than floats can tell, it mostly does.
static NSVCD__NOINLINE int nsvcd__patches_apart(nsvcd__proof *p, size_t i, size_t j, double u0,
                                                double u1) {
  const size_t moving_first = p->moving.first_triangle[i];
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_first = p->fixed.first_triangle[j];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  size_t top = fixed_first;
  double highest = -HUGE_VAL;
  for (size_t b = fixed_first; b < fixed_end; b++) {
    nsvcd__d3 corners[3];
    nsvcd__patch_triangle(&p->fixed, j, b, corners);
    for (size_t k = 0; k < 3; k++) {
      const double height = nsvcd__d3_dot(p->separating, corners[k]);
      if (height > highest) top = b;
      highest = nsvcd__max(highest, height);
    }
  }
  p->work += (fixed_end - fixed_first) / NSVCD__LANES;
  for (size_t a = moving_first; a < moving_end; a++) {
    const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, a, top);
    if ((a - moving_first) % 4 == 0) p->work++;
    if (!nsvcd__plane_separates(p, &pair, u0, u1)) return 0;
  }
  return 1;
}

// Lane l of the moving block, posed at both ends of an interval from u0 to u1 of the arc, and a
// block of the window: the triangle pairs that no plane separates are resolved one by one. The
// plane that separates one may separate others or, ALL_RESOLVED, all of both patches. TOO_LONG:
// they ask for more than `patience` parts of the interval or, without any, there is such a triangle
// pair.
static nsvcd__outcome nsvcd__resolve_row(nsvcd__solver *w, size_t l, nsvcd__block *fixed,
                                         nsvcd__arm arm, float margin, double u0, double u1,
                                         size_t patience) {
  nsvcd__proof *p = &w->p;
  const nsvcd__interval *over = w->blocks.over;
  const size_t i = w->blocks.moving.patch;
  const size_t j = fixed->patch;
  const float errors = nsvcd__errors_of(p, i, j);
  p->work++;
  uint32_t met = nsvcd__row_left(w, l, fixed, margin);
  for (; met; met &= met - 1) {
    const nsvcd__d3 before = p->separating;
    const nsvcd__f3 last = nsvcd__f3_round(before);
    const float along = errors + over->rounding + nsvcd__clearance(&p->goal) +
                        nsvcd__deviation_of(over, last, arm);
    met = nsvcd__left_by_normal(w, l, fixed, NSVCD__LAST_NORMAL, along, met);
    if (!met) break;
    if (patience == 0) return NSVCD__TOO_LONG;
    if (p->shared > NSVCD__SHARED * w->all_tried) {
      w->all_tried++;
      if (nsvcd__patches_apart(p, i, j, u0, u1)) return NSVCD__ALL_DONE;
    }
    const size_t a = w->blocks.moving.first + l;
    const size_t b = fixed->first + nsvcd__low_bit(met);
    const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, a, b);
    const nsvcd__outcome one = nsvcd__resolve_pair(p, &pair, u0, u1);
    if (one != NSVCD__DONE) return one;
    if (p->parts > patience) return NSVCD__TOO_LONG;
    p->shared = nsvcd__d3_distance2(p->separating, before) > 0 ? 0 : p->shared + 1;
  }
  return NSVCD__DONE;
}

// All triangle pairs of patches i and j over an interval from u0 to u1 of the arc.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_triangles(nsvcd__solver *w, size_t i,
                                                               size_t j,
                                                               const nsvcd__interval *over,
                                                               double u0, double u1,
                                                               size_t patience) {
  nsvcd__proof *p = &w->p;
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  const nsvcd__f3 axis = nsvcd__own_axis(over);
  const float stays = nsvcd__errors_of(p, i, j) + (over->rounding + over->origin_bend) +
                      nsvcd__clearance(&p->goal);
  const float error = p->moving.errors[i];
  const float extent = p->moving.body->extent + error;
  const nsvcd__arm all = {extent, extent};
  // else arms of blocks gain little
  const int bends = over->bend * extent > 0.25f * stays;
  p->parts = 0;
  w->all_tried = 0;
  for (size_t b = p->fixed.first_triangle[j]; b < fixed_end;
       b += NSVCD__WINDOW * NSVCD__LANES) {
    nsvcd__window_load(&w->blocks, &p->fixed, j, b);
    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {
      nsvcd__moving_block_load(&w->blocks, &p->moving, i, a);
      const nsvcd__arm arm = bends ? nsvcd__block_arm(&w->blocks.moving, axis, error) : all;
      const float margin = stays + nsvcd__bend_of(over, arm);
      nsvcd__block_pose(&w->blocks, NULL, over);
      for (size_t n = 0; n < w->blocks.window; n++) {
        nsvcd__block *fixed = &w->blocks.fixed[n];
        const uint32_t nearby =
            nsvcd__lanes_near(&w->blocks.moving, w->blocks.bounds[n], margin);
        uint32_t lanes = nsvcd__lanes_left_by_last(w, fixed, margin, nearby);
        p->work++;
        if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
        for (; lanes; lanes &= lanes - 1) {
          const nsvcd__outcome row = nsvcd__resolve_row(w, nsvcd__low_bit(lanes), fixed, arm,
                                                        margin, u0, u1, patience);
          if (row == NSVCD__ALL_DONE) return NSVCD__DONE;
          if (row != NSVCD__DONE) return row;
        }
      }
    }
  }
  return NSVCD__DONE;
}

// Resolves a patch pair that no plane separates over its segment, arc by arc. An arc is halved
// until each part is resolved by a plane between the hulls, or by the triangles.
static nsvcd__outcome nsvcd__resolve_patch_pair(nsvcd__solver *w, const nsvcd__search *q,
                                                const nsvcd__patch_pair *patches) {
  nsvcd__proof *p = &w->p;
  const nsvcd__motion *m = p->arcs.motion;
  const size_t i = patches->moving;
  const size_t j = patches->fixed;
  const uint32_t last = q->begin[patches->segment + 1u];
  double *ends = w->arc_ends;
  int is_tried = 1;  // is it all of the segment?
  for (uint32_t at = q->begin[patches->segment]; at < last && (double)at < p->known.end;) {
    double u;
    const uint32_t first = nsvcd__arc_of(m, (double)at, &u);
    const uint32_t keyframe = nsvcd__next_keyframe(m, first);
    at = last < keyframe ? last : keyframe;
    is_tried = is_tried && at == last;
    ends[0] = (double)(at - first) / (double)(keyframe - first);
    for (size_t left = 1; left > 0;) {
      nsvcd__arc_at(&p->arcs, first);
      const double end = nsvcd__min(ends[left - 1], nsvcd__arc_limit(p));
      if (!(u < end)) break;
      w->interval = nsvcd__interval_of_arc(p, first, u, end);
      const int apart = !is_tried && nsvcd__hulls_are_apart(w, i, j, &w->interval);
      is_tried = 0;
      if (!apart) {
        const int may_halve = end - u > NSVCD__SHORTEST && left < NSVCD__ARC_PARTS;
        const size_t patience = may_halve ? NSVCD__FEW_PARTS : (size_t)-1;
        const nsvcd__outcome part =
            nsvcd__resolve_triangles(w, i, j, &w->interval, u, end, patience);
        if (part == NSVCD__ANSWERED || part == NSVCD__EXHAUSTED) return part;
        if (part == NSVCD__TOO_LONG) ends[left++] = 0.5 * (u + end);
        if (part != NSVCD__DONE) continue;
      }
      u = end;
      left--;
    }
  }
  return NSVCD__DONE;
}

// Does any plane separate a patch pair over its segment?
static int nsvcd__is_separated(nsvcd__solver *w, const nsvcd__search *q,
                               const nsvcd__patch_pair *patches) {
  const nsvcd__interval *over = nsvcd__segment_interval(w, q, patches->segment);
  return nsvcd__hulls_are_apart(w, patches->moving, patches->fixed, over);
}

// Does a patch pair come before another? Deepest first. For the first contact: earliest closest
// approach within a segment, and earlier segments once a contact is known.
static int nsvcd__is_before(const nsvcd__proof *p, const nsvcd__patch_pair *a,
                            const nsvcd__patch_pair *b) {
  if (!(p->goal.first > 0)) return a->depth > b->depth;
  if (a->segment == b->segment) return a->fraction < b->fraction;
  return p->known.has_contact ? a->segment < b->segment : a->depth > b->depth;
}

static void nsvcd__sort_patch_pairs(const nsvcd__proof *p, nsvcd__patch_pair *pairs,
                                    size_t count) {
  for (size_t n = 1; n < count; n++) {
    const nsvcd__patch_pair patches = pairs[n];
    size_t at = n;
    for (; at > 0 && nsvcd__is_before(p, &patches, &pairs[at - 1]); at--)
      pairs[at] = pairs[at - 1];
    pairs[at] = patches;
  }
}

// Does a segment still matter?
static int nsvcd__matters(const nsvcd__proof *p, const nsvcd__search *q, size_t segment) {
  return (double)q->begin[segment] < p->known.end;
}

// Clips the segment in which the end of what matters lies. What leaves a chord by some length
// leaves that of a part of the time by no more than twice that, along any direction.
static NSVCD__NOINLINE void nsvcd__clip_segment(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  size_t s = 0;
  double u;
  if (!(p->known.end < w->clipped_end)) return;
  w->clipped_end = p->known.end;
  while (s < q->segments && !((double)q->begin[s + 1] > p->known.end)) s++;
  if (s == q->segments || !((double)q->begin[s] < p->known.end)) return;
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  const uint32_t first = nsvcd__arc_of(p->arcs.motion, p->known.end, &u);
  const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, first), u);
  const nsvcd__transform end = nsvcd__transform_of(&at);
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, l);
  const nsvcd__mat3 turned = nsvcd__mat3_mix(1, &end.rotation, -1, &start);
  const nsvcd__f3 position = nsvcd__lane_of(block->position, l);
  nsvcd__lane_set(nsvcd__f3_sub(end.position, position), block->moved, l);
  nsvcd__lane_set(turned.x, block->turned, l);
  nsvcd__lane_set(turned.y, block->turned + 3, l);
  nsvcd__lane_set(turned.z, block->turned + 6, l);
  if (!(w->clipped >> s & 1)) {
    block->margin[l] += block->origin_bend[l];
    block->bend[l] *= 2;
    block->origin_bend[l] *= 2;
    block->bend_along_axis[l] *= 2;
    block->origin_along_axis[l] *= 2;
    block->origin_off_heading[l] *= 2;
  }
  w->clipped |= (uint64_t)1 << s;
  w->memo.intervals &= ~((uint64_t)1 << s);
  q->ready &= ~((uint64_t)1 << s);
  // the heights over the plane that held last are no longer right
  w->memo.plane += w->memo.plane > 0;
}

// Resolves the patch pairs that no plane separates.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_patch_pairs(nsvcd__solver *w,
                                                                 nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  nsvcd__sort_patch_pairs(p, p->of.kept.pairs, w->count);
  for (size_t n = 0; n < w->count; n++) {
    const nsvcd__patch_pair *patches = &p->of.kept.pairs[n];
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    nsvcd__clip_segment(w, q);
    if (!nsvcd__matters(p, q, patches->segment)) continue;
    const int is_clipped = (w->clipped >> patches->segment & 1) != 0;
    if (is_clipped && nsvcd__is_separated(w, q, patches)) continue;
    const nsvcd__outcome outcome = nsvcd__resolve_patch_pair(w, q, patches);
    if (outcome != NSVCD__DONE) return outcome;
  }
  w->count = 0;
  return nsvcd__check_budget(p) ? NSVCD__EXHAUSTED : NSVCD__DONE;
}

// Sifts fresh patch pairs: drops those that planes separate, seeks a witness in the others, and
// keeps them. The plane that held last is tried on all of them first: it often holds for
// neighbours.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__sift_patch_pairs(nsvcd__solver *w,
                                                              nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  const int tells_more = p->goal.measure > 0 || p->goal.first > 0;
  size_t count = 0;
  nsvcd__clip_segment(w, q);
  for (size_t n = 0; n < w->fresh_count; n++) {
    if (nsvcd__held_again(w, q, &w->fresh[n])) continue;
    w->fresh[count++] = w->fresh[n];
  }
  w->fresh_count = 0;
  nsvcd__sort_patch_pairs(p, w->fresh, count);
  if (count > 0 && w->fresh[0].depth > NSVCD__DEEP &&
      nsvcd__seek_in_patch_pair(w, q, &w->fresh[0]) == NSVCD__ANSWERED)
    return NSVCD__ANSWERED;

  for (size_t n = 0; n < count; n++) {
    nsvcd__patch_pair *patches = &w->fresh[n];
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    nsvcd__clip_segment(w, q);
    if (!nsvcd__matters(p, q, patches->segment)) continue;
    if (nsvcd__held_again(w, q, patches)) continue;
    if (nsvcd__is_separated(w, q, patches)) continue;
    double u;
    const uint32_t first = nsvcd__arc_of(p->arcs.motion, q->begin[patches->segment], &u);
    if ((p->goal.first > 0 || p->shared > 0) &&
        nsvcd__is_straight(nsvcd__arc_at(&p->arcs, first))) {
      const nsvcd__outcome outcome = nsvcd__resolve_patch_pair(w, q, patches);
      if (outcome != NSVCD__DONE) return outcome;
      continue;
    }
    if (w->misses >= NSVCD__FEW_MISSES) {
      const nsvcd__interval *over = nsvcd__segment_interval(w, q, patches->segment);
      const nsvcd__outcome by_triangles =
          nsvcd__resolve_triangles(w, patches->moving, patches->fixed, over, 0, 0, 0);
      if (by_triangles == NSVCD__DONE) continue;
    }
    const int may_meet = tells_more || w->misses < NSVCD__MANY_MISSES;
    if (may_meet && !patches->sought &&
        nsvcd__seek_in_patch_pair(w, q, patches) == NSVCD__ANSWERED)
      return NSVCD__ANSWERED;
    w->misses++;
    if (w->count == NSVCD__PATCH_PAIRS) {
      const nsvcd__outcome outcome = nsvcd__resolve_patch_pairs(w, q);
      if (outcome != NSVCD__DONE) return outcome;
    }
    p->of.kept.pairs[w->count++] = *patches;
  }
  return NSVCD__DONE;
}

// Is there room for contacts, and can those that were collected still be undone?
static int nsvcd__collects_on(const nsvcd__proof *p) {
  return p->push.contact_count < NSVCD__TOUCHES && !p->push.too_deep;
}

// Collects the contacts of fresh patch pairs at the start, or the patch pairs where contact points
// may be. EXHAUSTED: there is no room for more, or no budget.
static nsvcd__outcome nsvcd__collect_contacts(nsvcd__solver *w, const nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  for (size_t n = 0; n < w->fresh_count && nsvcd__collects_on(p); n++) {
    const nsvcd__patch_pair *patches = &w->fresh[n];
    if (nsvcd__held_again(w, q, patches)) continue;
    if (nsvcd__is_separated(w, q, patches)) continue;
    if (p->goal.collects == NSVCD__TOUCHING) {
      if (p->push.normal_count > 0) {
        // just pushed out: farther than the clearance by less than floats can tell
        (void)nsvcd__arc_at(&p->arcs, 0);
        if (nsvcd__patches_apart(p, patches->moving, patches->fixed, 0, 0)) continue;
      }
      (void)nsvcd__find_witness(w, patches->moving, patches->fixed, 0, 0);
    } else if (w->count < NSVCD__PATCH_PAIRS) {
      p->of.kept.pairs[w->count++] = *patches;
    }
  }
  w->fresh_count = 0;
  const int goes_on = nsvcd__collects_on(p) && p->work <= p->goal.limit;
  return goes_on ? NSVCD__DONE : NSVCD__EXHAUSTED;
}

// Bounds, along directions first .. last - 1 of a manifold, of the points on both patches of a
// patch pair, the moving one posed: they are in both hulls.
static void nsvcd__bound_of(const nsvcd__proof *p, const nsvcd__transform *pose,
                            const nsvcd__patch_pair *patches, int first, int last,
                            float *most) {
  const nsvcd__manifold *m = &p->of.kept.manifold;
  const float scale = p->arcs.motion->scale;
  const float margin = scale * p->moving.margins[patches->moving] + (float)m->tolerance;
  const float fixed_margin = p->fixed.margins[patches->fixed];
  for (int k = first; k < last; k++) {
    const nsvcd__v3 along = nsvcd__v3_set(nsvcd__d3_narrow(m->along[k]));
    float moving = -HUGE_VALF;
    float fixed = -HUGE_VALF;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 hull = nsvcd__hull_of(&p->moving, patches->moving, l);
      const nsvcd__v3 other = nsvcd__hull_of(&p->fixed, patches->fixed, l);
      const nsvcd__v height = nsvcd__v3_dot(along, nsvcd__v3_transform(pose, hull));
      moving = nsvcd__greatest_of(moving, height);
      fixed = nsvcd__greatest_of(fixed, nsvcd__v3_dot(along, other));
    }
    most[k] = fminf(margin + moving, fixed_margin + fixed);
  }
}

// The manifold of the patch pairs that were collected, in directions first .. last - 1: first of
// those with the farthest bound along one, then of those that may still be farther. Where bodies
// are deep in each other there are many, with few points that are like a contact: so only so many
// are tried.
static NSVCD__NOINLINE void nsvcd__seek_positions(nsvcd__solver *w, int first, int last) {
  nsvcd__proof *p = &w->p;
  nsvcd__manifold *m = &p->of.kept.manifold;
  nsvcd__patch_pair *pairs = p->of.kept.pairs;
  const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, 0), 0);
  const nsvcd__transform pose = nsvcd__transform_of(&at);
  size_t tries = 0;
  float farthest[NSVCD__SUPPORTS];
  size_t best[NSVCD__SUPPORTS] = {0};
  float most[NSVCD__SUPPORTS];
  for (int k = first; k < last; k++) farthest[k] = -HUGE_VALF;
  for (size_t n = 0; n < w->count; n++) {
    pairs[n].sought = 0;
    nsvcd__bound_of(p, &pose, &pairs[n], first, last, most);
    for (int k = first; k < last; k++) {
      if (most[k] > farthest[k]) best[k] = n;
      farthest[k] = fmaxf(farthest[k], most[k]);
    }
  }
  const size_t count = (size_t)(last - first);
  for (size_t n = 0; n < count + w->count && w->count > 0; n++) {
    const size_t which = n < count ? best[(size_t)first + n] : n - count;
    nsvcd__patch_pair *patches = &pairs[which];
    int matters = 0;
    nsvcd__bound_of(p, &pose, patches, first, last, most);
    for (int k = first; k < last; k++) matters |= (double)most[k] > m->farthest[k] + m->same;
    if (patches->sought || !matters) continue;
    if (tries == NSVCD__CONTACT_PAIRS ||
        (tries == NSVCD__FEW_MISSES && !(m->farthest[first] > -HUGE_VAL)))
      break;
    patches->sought = 1;
    tries++;
    (void)nsvcd__find_witness(w, patches->moving, patches->fixed, 0, 0);
  }
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------- separate/containment
// In: two bodies that do not touch at a time. Out: is a component of one inside the other? By rays,
// in double.

#ifndef NSVCD_NO_PROOF
// A ray in a body's frame. What it crosses tells whether the body encloses the point it starts at.
typedef struct nsvcd__ray {
  nsvcd__d3 from, direction;
  // A ray that passes an edge within this tells nothing. rounding: the same plus what floats add.
  double margin;
  float rounding;
} nsvcd__ray;

// +1 if the ray leaves through the triangle, -1 if it enters, 0 if it misses. Sets *unclear if it
// passes an edge.
static int nsvcd__ray_crosses(const nsvcd__ray *ray, const nsvcd__d3 *t, double margin,
                              int *unclear) {
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  double nearest = HUGE_VAL;
  const nsvcd__d3 n = nsvcd__face_normal(t);
  // the signed volumes of each edge and the ray: all of one sign if it passes inside
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[(k + 1) % 3], t[k]);
    const nsvcd__d3 across = nsvcd__d3_cross(edge, ray->direction);
    const double length = nsvcd__d3_norm(across);
    const double volume = nsvcd__d3_dot(across, nsvcd__d3_sub(t[k], ray->from));
    least = nsvcd__min(least, volume);
    most = nsvcd__max(most, volume);
    nearest = nsvcd__min(nearest, length > 0 ? fabs(volume) / length : 0);
  }
  const double slope = nsvcd__d3_dot(n, ray->direction);
  const double height = nsvcd__d3_dot(n, nsvcd__d3_sub(t[0], ray->from));
  const double size = nsvcd__d3_norm(n);
  const int is_on_it = fabs(height) <= margin * size;
  if (height * slope < 0 && !is_on_it) return 0;  // it is behind
  if (nearest <= margin) {
    // It is near an edge's line, but is it near the triangle?
    nsvcd__d3 far_end = nsvcd__d3_add(ray->from, nsvcd__d3_scale(ray->direction, 4 * 1.6e7));
    nsvcd__nearest near_edge = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < 3; k++)
      nsvcd__edges_nearest(ray->from, far_end, t[k], t[(k + 1) % 3], &near_edge);
    if (near_edge.square <= 4 * margin * margin) *unclear = 1;
    if (least < 0 && most > 0) return 0;
  }
  if (least <= 0 && most >= 0) return 0;
  if (is_on_it) *unclear = 1;
  return slope > 0 ? 1 : slope < 0 ? -1 : 0;
}

// Adds a triangle to the list of those that a ray has crossed. Returns 0 if it is there already.
// Sets *unclear if there is no room.
static int nsvcd__is_new(nsvcd__solver *w, size_t *count, uint32_t number, int *unclear) {
  for (size_t k = 0; k < *count; k++) {
    if (w->crossed[k] == number) return 0;
  }
  if (*count == NSVCD__CROSSED) *unclear = 1;
  if (*count < NSVCD__CROSSED) w->crossed[(*count)++] = number;
  return 1;
}

// Lanes of a block whose triangles the ray crosses, or passes within the margin, and some more. The
// signed volumes of the edges and the ray are off by no more than `rounding`, square metres: see
// nsvcd__cross_all.
static uint32_t nsvcd__lanes_on_ray(nsvcd__block *block, const nsvcd__ray *ray, float margin,
                                    float rounding) {
  const nsvcd__f3 start = nsvcd__f3_round(ray->from);
  const nsvcd__f3 heading = nsvcd__f3_round(ray->direction);
  uint32_t missed = 0;
  NSVCD__EACH_SLICE(l) {
    nsvcd__v least = nsvcd__v_set(HUGE_VALF);
    nsvcd__v most = nsvcd__v_set(-HUGE_VALF);
    nsvcd__v longest = nsvcd__v_set(0);
    for (size_t k = 0; k < 3; k++) {
      const nsvcd__v3 corner = nsvcd__v3_load(block->corners[k], l);
      const nsvcd__v3 next = nsvcd__v3_load(block->corners[(k + 1) % 3], l);
      const nsvcd__v3 edge = nsvcd__v3_sub(next, corner);
      const nsvcd__v3 across = nsvcd__v3_cross(edge, nsvcd__v3_set(heading));
      const nsvcd__v3 to_corner = nsvcd__v3_sub(corner, nsvcd__v3_set(start));
      const nsvcd__v volume = nsvcd__v3_dot(across, to_corner);
      least = nsvcd__v_min(least, volume);
      most = nsvcd__v_max(most, volume);
      longest = nsvcd__v_max(longest, nsvcd__v3_norm(across));
    }
    const nsvcd__v allowed =
        nsvcd__v_fma(nsvcd__v_set(margin), longest, nsvcd__v_set(rounding));
    missed |= (nsvcd__v_lt(least, nsvcd__v_negate(allowed)) & nsvcd__v_lt(allowed, most)) << l;
  }
  return nsvcd__block_lanes(block) & ~missed;
}

// What a ray crosses.
typedef struct nsvcd__crossings {
  int winds;       // how often the closed surfaces wind about the ray's point
  int either_way;  // triangles of surfaces whose winding tells nothing
  int nearly;      // triangles of what is nearly a solid
  int unclear;     // the ray cannot tell
} nsvcd__crossings;

// What one ray crosses. A triangle counts once, even if several patches list it or parts of it. A
// ray that comes as near to an edge as a closed gap is wide does not count: so none passes through
// a gap.
//
// The error of the signed volumes of nsvcd__lanes_on_ray, with u = 2^-24, E the extent, and R the
// extent plus the distance of the ray's point: A corner, a vertex of up to E from a centre of up to
// E, is off by 2 u E. An edge, of up to 2 E, is off by two corners and its own rounding, 6 u E. Its
// product with the direction, rounded as well, is off by 6 + 2 + 2.31 x 2 (|a_y b_z| + |a_z b_y|
// and so on are no more than 1.155 |a| |b| together) = 12.7 u E. A point on the edge, up to R from
// the ray's, is off by 3 u R. So the volume is off by 12.7 u E R + 2 E x 3 u R, and by 3 roundings
// of up to 2 E R: 24.7 u E R, less than 1.5e-6 E R. NSVCD__ROUNDING is more.
static nsvcd__crossings nsvcd__cross_all(nsvcd__solver *w, const nsvcd__geometry *f,
                                         const nsvcd__ray *ray) {
  nsvcd__proof *p = &w->p;
  nsvcd__block *block = &w->blocks.fixed[0];
  w->blocks.window = 0;
  const float extent = (float)nsvcd__d3_norm(ray->from) + f->body->extent;
  const float rounding = NSVCD__ROUNDING * extent * f->body->extent;
  nsvcd__crossings sum = {0, 0, 0, 0};
  size_t count = 0;
  size_t g;
  const nsvcd__beam beam = {nsvcd__f3_round(ray->from), nsvcd__f3_round(ray->direction),
                            ray->rounding};
  nsvcd__traversal groups;
  nsvcd__traversal_begin(&groups, f->body, nsvcd__is_on_beam, &beam);
  while (!sum.unclear && nsvcd__traversal_next(&groups, &g)) {
    const nsvcd__spheres all = nsvcd__body_patches(f->body);
    uint32_t patches = nsvcd__is_on_beam(&beam, nsvcd__spheres_from(all, NSVCD__GROUP * g));
    for (; patches && !sum.unclear; patches &= patches - 1) {
      const size_t i = NSVCD__GROUP * g + nsvcd__low_bit(patches);
      if (i >= f->body->patches) break;
      const float about = 2 * (f->errors[i] + (float)ray->margin);
      const size_t end = f->first_triangle[i + 1];
      nsvcd__numbers numbers = nsvcd__numbers_of(f, i);
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        p->work++;
        uint32_t lanes = nsvcd__lanes_on_ray(block, ray, about, rounding);
        for (; lanes; lanes &= lanes - 1) {
          const size_t entry = n + nsvcd__low_bit(lanes);
          nsvcd__d3 corners[3];
          nsvcd__read_number(&numbers, entry);
          if (numbers.kind == NSVCD__SHEET) continue;
          p->work++;
          nsvcd__patch_triangle(f, i, entry, corners);
          const int crossing = nsvcd__ray_crosses(ray, corners, ray->margin, &sum.unclear);
          if (!crossing || !nsvcd__is_new(w, &count, numbers.number, &sum.unclear)) continue;
          if (numbers.kind == NSVCD__CLOSED) sum.winds += crossing;
          sum.either_way += numbers.kind == NSVCD__EITHER_DIRECTION;
          sum.nearly += numbers.kind == NSVCD__NEARLY;
        }
      }
    }
  }
  return sum;
}

// Lanes of 16 spheres that meet this one; a filter of a traversal.
static uint32_t nsvcd__meets_sphere(const void *what, nsvcd__spheres all) {
  const nsvcd__sphere *here = (const nsvcd__sphere *)what;
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_set(here->centre);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), centre);
    const nsvcd__v radius = nsvcd__v_plus(nsvcd__v_load(all.r + l), here->radius);
    met |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(radius)) << l;
  }
  return met;
}

// Is a triangle so close to the point that the mesh's own may be on the other side of it?
static int nsvcd__surface_is_near(nsvcd__solver *w, const nsvcd__geometry *f, nsvcd__d3 point,
                                  double tolerance) {
  const nsvcd_body *b = f->body;
  const nsvcd__d3 as_triangle[3] = {point, point, point};
  const nsvcd__f3 rounded = nsvcd__f3_round(point);
  const nsvcd__box at = {rounded, rounded};
  const float extent = nsvcd__f3_norm(rounded) + b->extent;
  const float distance =
      2 * nsvcd__widest_error(f) + (float)tolerance * 1.0001f + 4 * NSVCD__ROUNDING * extent;
  const double off = (double)nsvcd__off_mesh(f) + NSVCD__SAME_POSITION * (double)extent;
  const double limit = 2 * off + tolerance;
  const nsvcd__sphere here = {rounded, distance};
  nsvcd__block *block = &w->blocks.fixed[0];
  size_t g;
  nsvcd__traversal groups;
  w->blocks.window = 0;
  nsvcd__traversal_begin(&groups, b, nsvcd__meets_sphere, &here);
  while (nsvcd__traversal_next(&groups, &g)) {
    const size_t first = NSVCD__GROUP * g;
    const nsvcd__spheres members = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    for (uint32_t met = nsvcd__meets_sphere(&here, members); met; met &= met - 1) {
      const size_t i = first + nsvcd__low_bit(met);
      if (i >= b->patches) break;
      const size_t end = f->first_triangle[i + 1];
      for (size_t n = f->first_triangle[i]; n < end; n += NSVCD__LANES) {
        nsvcd__block_load(f, i, n, end - n < NSVCD__LANES ? end - n : NSVCD__LANES, block);
        w->p.work++;
        uint32_t lanes = nsvcd__lanes_near(block, at, distance);
        for (; lanes; lanes &= lanes - 1) {
          nsvcd__d3 corners[3];
          nsvcd__patch_triangle(f, i, n + nsvcd__low_bit(lanes), corners);
          if (nsvcd__nearest_of(as_triangle, corners).square <= limit * limit) return 1;
        }
      }
    }
  }
  return 0;
}

// Does the body enclose a point of its frame, farther from its surface than rounding? Rays tell, in
// directions that no mesh is likely to be aligned with. The first one goes to the side of the body
// that the point is on. One ray is enough where all surfaces are closed. Of what is nearly a solid,
// the majority of the rays tells whether its winding number is more than a half: then the point is
// not known to be outside. (Difference from Jacobson 2013: rays, not a sum of solid angles.) unit:
// of the body's frame.
static int nsvcd__is_enclosed(nsvcd__solver *w, const nsvcd__geometry *f, double unit,
                              nsvcd__d3 point) {
  nsvcd__proof *p = &w->p;
  static const double directions[8][3] = {
      {0.5359, 0.6013, 0.5927},   {-0.5741, 0.6229, 0.5314},  {0.6127, -0.5531, 0.5644},
      {-0.5477, -0.5923, 0.5909}, {0.6311, 0.5573, -0.5396},  {-0.6053, 0.5297, -0.5941},
      {0.5623, -0.6217, -0.5452}, {-0.5849, -0.5407, -0.6047}};
  const nsvcd__d3 centre = nsvcd__d3_load(f->body->centre);
  const nsvcd__d3 off = nsvcd__d3_sub(point, centre);
  const double radius = (double)f->body->radius;
  if (f->body->open || nsvcd__d3_dot(off, off) > 1.00001 * radius * radius) return 0;
  const size_t best = (off.x < 0 ? 1u : 0u) + (off.y < 0 ? 2u : 0u) + (off.z < 0 ? 4u : 0u);
  nsvcd__ray ray;
  ray.from = point;
  ray.margin = NSVCD__SAME_POSITION * (double)p->given.lengths / unit;
  ray.margin += (double)nsvcd__off_mesh(f) + (double)f->counts->gap;
  ray.rounding = (float)ray.margin + 4 * NSVCD__ROUNDING * f->body->extent;
  int clear = 0;
  int odd = 0;
  for (size_t n = 0; n < 8; n++) {
    const double *d = directions[best ^ n];
    if (p->work > p->goal.limit) {
      w->unclear = NSVCD__NOT_ASKED;
      return 0;
    }
    ray.direction = nsvcd__d3_of(d[0], d[1], d[2]);
    ray.direction = nsvcd__d3_scale(ray.direction, 1 / nsvcd__d3_norm(ray.direction));
    const nsvcd__crossings sum = nsvcd__cross_all(w, f, &ray);
    if (sum.unclear) continue;
    // A hollow of one kind inside the other undoes it.
    if ((sum.winds != 0) != (sum.either_way % 2 != 0)) return 1;
    if (f->kind_bits == 1) return 0;
    odd += sum.nearly % 2 != 0 || sum.winds != 0;
    clear++;
  }
  if (clear == 0 || 2 * odd > clear) w->unclear = NSVCD__CANNOT_TELL;
  w->in_open |= clear > 0 && 2 * odd > clear;
  return 0;
}

// Does some patch of a body lie outside of the other's sphere? start: from the first body's frame
// to the second's, in which the first has this scale.
static int nsvcd__sticks_out(const nsvcd__geometry *inner, const nsvcd__transform *start,
                             float scale, const nsvcd_body *outer) {
  const nsvcd_body *b = inner->body;
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_load(outer->centre));
  const float rounding = 4 * NSVCD__ROUNDING * (scale * b->extent + outer->extent);
  const nsvcd__v radius = nsvcd__v_set(outer->radius + rounding);
  for (size_t first = 0; first < b->padded; first += NSVCD__LANES) {
    const nsvcd__spheres patches = nsvcd__spheres_from(nsvcd__body_patches(b), first);
    uint32_t out = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 seen = nsvcd__v3_transform(start, nsvcd__v3_centres(patches, l));
      const nsvcd__v3 d = nsvcd__v3_sub(seen, centre);
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

// Two bodies at the start of the motion: is `inner` in `outer`?
typedef struct nsvcd__enclosure {
  const nsvcd__geometry *inner, *outer;
  // from the inner body's frame to the outer one's, that in float, and its inverse
  nsvcd__dtransform start;
  nsvcd__transform rounded;
  nsvcd__dtransform back;
  // of the inner body in the outer one's frame; of that frame, in the fixed body's units
  float scale;
  double unit;
} nsvcd__enclosure;

// May a seed be in the outer body? It is in the sphere and the box about that.
static int nsvcd__seed_is_near(const nsvcd__enclosure *e, const float *seed) {
  const nsvcd_body *o = e->outer->body;
  const float extents = e->scale * e->inner->body->extent + o->extent;
  const float lengths = nsvcd__f3_norm(e->rounded.position) + extents;
  const float rounding = 4 * NSVCD__ROUNDING * lengths;
  const float radius = o->radius + rounding;
  const nsvcd__f3 margin = nsvcd__f3_of(rounding, rounding, rounding);
  const nsvcd__f3 low = nsvcd__f3_sub(nsvcd__f3_load(e->outer->box), margin);
  const nsvcd__f3 high = nsvcd__f3_add(nsvcd__f3_load(e->outer->box + 3), margin);
  const nsvcd__f3 seen = nsvcd__f3_transform(&e->rounded, nsvcd__f3_load(seed));
  const nsvcd__f3 d = nsvcd__f3_sub(seen, nsvcd__f3_load(o->centre));
  const int in_box = !nsvcd__f3_exceeds(low, seen) && !nsvcd__f3_exceeds(seen, high);
  return in_box && nsvcd__f3_dot(d, d) <= radius * radius;
}

// Is one of the inner body's components, with seeds first .. end - 1, in the outer body? Then
// w->inside is set, and w->enclosed is its seed. Returns 1 if that is certain.
static int nsvcd__contains_seeds(nsvcd__solver *w, const nsvcd__enclosure *e, size_t first,
                                 size_t end) {
  nsvcd__proof *p = &w->p;
  for (size_t n = first; n < end; n++) {
    if (!nsvcd__seed_is_near(e, e->inner->seeds + 3 * n)) continue;
    if (nsvcd__check_budget(p)) {
      w->unclear = NSVCD__NOT_ASKED;
      return 0;
    }
    const nsvcd__d3 seed = nsvcd__d3_load(e->inner->seeds + 3 * n);
    const nsvcd__d3 seen = nsvcd__d3_transform(&e->start, seed);
    if (!nsvcd__is_enclosed(w, e->outer, e->unit, seen)) continue;
    w->enclosed = e->inner == &p->moving ? seen : seed;
    w->inside = 1;
    const double room = p->given.tolerance / e->unit + (double)e->outer->counts->gap;
    if (!nsvcd__surface_is_near(w, e->outer, seen, room)) return 1;
  }
  return 0;
}

// The same of all components. Where there are many, only groups near the outer body are asked for
// theirs.
static int nsvcd__contains_any(nsvcd__solver *w, const nsvcd__enclosure *e) {
  const nsvcd_body *inner = e->inner->body;
  const nsvcd_body *outer = e->outer->body;
  if (outer->open) return 0;
  const int is_one = e->inner->counts->components == 1 && e->outer->kind_bits == 1;
  if (is_one && nsvcd__sticks_out(e->inner, &e->rounded, e->scale, outer)) return 0;
  if (e->inner->counts->components <= NSVCD__LANES)
    return nsvcd__contains_seeds(w, e, 0, e->inner->counts->components);
  const nsvcd__f3 centre =
      nsvcd__f3_round(nsvcd__d3_transform(&e->back, nsvcd__d3_load(outer->centre)));
  const float extent = nsvcd__f3_norm(centre) + inner->extent + outer->extent / e->scale;
  const float rounding = 4 * NSVCD__ROUNDING * extent;
  const nsvcd__sphere here = {centre, outer->radius / e->scale + rounding};
  size_t g;
  nsvcd__traversal groups;
  nsvcd__traversal_begin(&groups, inner, nsvcd__meets_sphere, &here);
  while (!w->unclear && nsvcd__traversal_next(&groups, &g)) {
    if (nsvcd__contains_seeds(w, e, e->inner->first_seed[g], e->inner->first_seed[g + 1]))
      return 1;
  }
  return 0;
}

// Is a component of one body inside the other at the start of the motion? Then w->enclosed is its
// seed. A seed so close to the surface that errors matter returns 0, with w->inside set. If planes
// then separate all patches at t = 0, the seed, the surface that was tested and the true one are,
// patch by patch, on one side of a plane and agree: it is inside.
static NSVCD__NOINLINE int nsvcd__is_contained_at_start(nsvcd__solver *w) {
  nsvcd__proof *p = &w->p;
  const float scale = p->arcs.motion->scale;
  const nsvcd__dtransform start = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, 0), 0);
  const nsvcd__dtransform back = nsvcd__inverse_dtransform(&start, p->arcs.arc.scale);
  const nsvcd__enclosure moving = {&p->moving, &p->fixed, start, nsvcd__transform_of(&start),
                                   back,       scale,     1};
  if (nsvcd__contains_any(w, &moving)) return 1;
  const nsvcd__enclosure fixed = {
      &p->fixed, &p->moving,       back, nsvcd__transform_of(&back), start,
      1 / scale, p->arcs.arc.scale};
  return nsvcd__contains_any(w, &fixed);
}
#endif  // NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- separate/loop
// In: a question, and a motion that has been cut into segments. Out: all of it resolved, or a
// contact that answers the question, or the budget exhausted.

#ifndef NSVCD_NO_PROOF
// Segments from .. to - 1, as bits.
static uint64_t nsvcd__segments_in(size_t from, size_t to) {
  const uint64_t before_end = to < 64 ? ((uint64_t)1 << to) - 1 : ~(uint64_t)0;
  return before_end & ~(((uint64_t)1 << from) - 1);
}

// The segments being searched that still matter.
static uint64_t nsvcd__segments_that_matter(const nsvcd__proof *p, const nsvcd__search *q) {
  size_t s = q->segments;
  if (!(p->goal.first > 0) || !p->known.has_contact) return q->wanted;
  while (s > 0 && !nsvcd__matters(p, q, s - 1)) s--;
  return q->wanted & nsvcd__segments_in(0, s);
}

// Adds the patch pairs of moving group g and fixed patch j in the segments *left, and clears
// these, as long as there is room for 16 more.
static void nsvcd__add_patch_pairs(nsvcd__solver *w, const nsvcd__search *q, size_t g,
                                   size_t j, uint64_t *left) {
  nsvcd__proof *p = &w->p;
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const nsvcd__f3 centre = nsvcd__patch_centre(&p->fixed, j);
  const float radius = nsvcd__body_r(fixed)[j];
  const float *own = nsvcd__body_r(moving) + NSVCD__GROUP * g;
  *left &= nsvcd__segments_that_matter(p, q);
  for (; *left && w->fresh_count + NSVCD__GROUP <= NSVCD__FRESH; *left &= *left - 1) {
    const size_t s = nsvcd__low_bit(*left);
    const nsvcd__chords *c = &q->members[s];
    float squares[NSVCD__LANES];
    float fraction[NSVCD__LANES];
    uint32_t met = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(centre));
      const nsvcd__v tau = nsvcd__nearest_at(d, travel, nsvcd__v_load(c->inverse + l));
      const nsvcd__v3 closest = nsvcd__v3_fma(tau, travel, d);
      const nsvcd__v square = nsvcd__v3_dot(closest, closest);
      const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(c->radius + l), radius);
      met |= nsvcd__v_le(square, nsvcd__v_signed_square(sum)) << l;
      nsvcd__v_store(squares + l, square);
      nsvcd__v_store(fraction + l, tau);
    }
    if (!met) continue;
    met = nsvcd__slabs_meet(p, nsvcd__segment_interval(w, q, s), q, g, j, s, met);
    for (; met; met &= met - 1) {
      const size_t l = nsvcd__low_bit(met);
      const size_t i = NSVCD__GROUP * g + l;
      if (p->moving.hull_counts[i] == 0) continue;
      const float radii = q->scale * own[l] + radius;
      const float depth = 1 - sqrtf(squares[l]) / (radii > 1e-30f ? radii : 1e-30f);
      const nsvcd__patch_pair pair = {(uint16_t)i, (uint16_t)j, (uint16_t)s,
                                      0,           depth,       fraction[l]};
      w->fresh[w->fresh_count++] = pair;
    }
  }
}

// Processes the patch pairs that the search has found since.
static nsvcd__outcome nsvcd__take_patch_pairs(nsvcd__solver *w, nsvcd__search *q) {
  return w->p.goal.collects ? nsvcd__collect_contacts(w, q) : nsvcd__sift_patch_pairs(w, q);
}

// THE LOOP: point 2 of the theorem. Spheres and slabs separate groups of a tile of the moving body
// and one of the fixed body, and then patches of the groups left. What is left of these are patch
// pairs, for nsvcd__sift_patch_pairs and nsvcd__resolve_patch_pairs. In the end each pair of
// patches, in each segment that is wanted and still matters, has been separated, or has given a
// contact that answers or shrinks the question, or is an unresolved pair, or was resolved by its
// parts; or EXHAUSTED says that it has not.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__prove_segments(nsvcd__solver *w,
                                                            nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  nsvcd__outcome outcome;
  for (; q->step < q->steps; q->step++) {
    const size_t next = q->order[q->step];
    const size_t g = q->moving_tile.groups[next];
    nsvcd__search_group(q);
    nsvcd__separate_groups(p, q);
    for (; q->waiting; q->waiting &= q->waiting - 1) {
      const size_t at = nsvcd__low_bit(q->waiting);
      const size_t h = q->fixed_tile.groups[at];
      const uint64_t wanted = nsvcd__nearby(q, next)[at] & nsvcd__segments_that_matter(p, q);
      uint32_t met = nsvcd__group_against_members(q, h, wanted, w->met_in);
      for (; met; met &= met - 1) {
        const size_t l = nsvcd__low_bit(met);
        uint64_t *left = &w->met_in[l];
        if (p->fixed.hull_counts[NSVCD__GROUP * h + l] == 0) continue;
        for (;;) {
          nsvcd__pose_members(q, g, *left);
          nsvcd__add_patch_pairs(w, q, g, NSVCD__GROUP * h + l, left);
          if (!*left) break;
          outcome = nsvcd__take_patch_pairs(w, q);
          if (outcome != NSVCD__DONE) return outcome;
        }
      }
      if (w->fresh_count < NSVCD__ENOUGH_FRESH) continue;
      outcome = nsvcd__take_patch_pairs(w, q);
      if (outcome != NSVCD__DONE) return outcome;
    }
  }
  outcome = nsvcd__take_patch_pairs(w, q);
  if (outcome != NSVCD__DONE || p->goal.collects) return outcome;
  return nsvcd__resolve_patch_pairs(w, q);
}

// The same for all tiles of a motion that has been cut. If the first contact is sought, some
// segments of a tile at a time, until there is a contact: it is the first of the tile. What is
// resolved in one tile says nothing of the others.
static nsvcd__outcome nsvcd__prove_tiles(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const size_t all = q->segments;
  const size_t few = p->goal.first > 0 ? NSVCD__IN_ORDER : all;
  nsvcd__outcome outcome = NSVCD__DONE;
  (void)nsvcd__search_begin(moving, fixed, nsvcd__segments_in(0, all), q);
  do {
    for (size_t s = 0; s < all && outcome == NSVCD__DONE; s += few) {
      const size_t next = s + few < all ? s + few : all;
      if (!nsvcd__matters(p, q, s)) break;
      q->wanted = nsvcd__segments_in(s, next);
      q->step = 0;
      q->waiting = 0;
      outcome = nsvcd__prove_segments(w, q);
      const int one_tile = !nsvcd__is_tiled(moving, fixed);
      if (outcome == NSVCD__DONE && !p->known.has_contact && one_tile)
        p->known.proven_until = (double)q->begin[next];
    }
  } while (outcome == NSVCD__DONE && nsvcd__search_next_tile(q));
  if (outcome == NSVCD__DONE && !p->known.has_contact)
    p->known.proven_until = (double)q->begin[all];
  return outcome;
}

// THE WAIST: until when do the bodies stay apart in the segments that have been chosen, and what do
// they meet? Cuts the segments, and separates the bodies in them.
static NSVCD__NOINLINE nsvcd__search_result nsvcd__separate(nsvcd__solver *w, nsvcd__search *q,
                                                            const nsvcd__goal *goal) {
  nsvcd__proof *p = &w->p;
  p->arcs.motion = goal->motion;
  p->goal = *goal;
  p->goal.first = goal->fraction * (double)goal->motion->ticks;
  p->known.end = nsvcd__min(p->known.end, goal->end);
  nsvcd__cut_segments(goal->motion, p->given.lengths, nsvcd__clearance(goal), q);
  p->known.outcome = nsvcd__prove_tiles(w, q);
  p->known.ran_out = p->known.outcome == NSVCD__EXHAUSTED;
  p->known.clearance = p->goal.clearance;
  return p->known;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------- separate/distance_bound
// In: a motion whose segments have been chosen. Out: an upper bound of the least distance, which
// two vertices have at some time: the search for that distance begins with it.

#ifndef NSVCD_NO_PROOF
// Of the patches with a surface, the one whose centre is nearest to a point of the body's frame. Of
// a large body, one near it: the nearest sphere on each level leads there.
static size_t nsvcd__patch_near(const nsvcd__geometry *f, nsvcd__f3 point) {
  const nsvcd_body *body = f->body;
  size_t from = 0;
  size_t count = body->patches;
  size_t patch = 0;
  float least = HUGE_VALF;
  size_t k = nsvcd__is_large(body) ? nsvcd__level_count(body->padded) : 0;
  if (k > 0) count = nsvcd__level_of(body->padded, k - 1).count;
  while (k-- > 0) {
    const nsvcd__level level = nsvcd__level_of(body->padded, k);
    const nsvcd__spheres all = nsvcd__level_spheres(body, level);
    size_t nearest = from;
    float best = HUGE_VALF;
    for (size_t n = from; n < from + count && n < level.count; n++) {
      const nsvcd__f3 off = nsvcd__f3_sub(nsvcd__centre_of(all, n), point);
      const float distance = nsvcd__f3_norm(off) - all.r[n];
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
          nsvcd__v3_sub(nsvcd__v3_centres(patches, first + l), nsvcd__v3_set(point));
      const nsvcd__v square = nsvcd__v3_dot(off, off);
      nearer |= nsvcd__v_lt(square, nsvcd__v_set(least)) << l;
      nsvcd__v_store(squares + l, square);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t l = nsvcd__low_bit(nearer);
      const size_t n = first + l;
      if (n >= body->patches || f->hull_counts[n] == 0 || squares[l] >= least) continue;
      least = squares[l];
      patch = n;
    }
  }
  return patch;
}

// When the sphere whose chords are q->group comes nearest to a fixed one, in ticks. Returns 0
// if that is no nearer than *gap, metres; else *gap becomes how near.
static int nsvcd__nearest_tick(const nsvcd__search *q, nsvcd__sphere fixed, float *gap,
                               double *tick) {
  int found = 0;
  for (size_t b = 0; NSVCD__LANES * b < q->segments; b++) {
    const nsvcd__chords *c = &q->group[b];
    float gaps[NSVCD__LANES], fraction[NSVCD__LANES];
    uint32_t nearer = 0;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 travel = nsvcd__chords_travel(c, l);
      const nsvcd__v3 d =
          nsvcd__v3_sub(nsvcd__chords_start(c, l), nsvcd__v3_set(fixed.centre));
      const nsvcd__v tau = nsvcd__nearest_at(d, travel, nsvcd__v_load(c->inverse + l));
      const nsvcd__v3 off = nsvcd__v3_fma(tau, travel, d);
      const nsvcd__v radius = nsvcd__v_load(c->radius + l);
      const nsvcd__v between = nsvcd__v_sub(nsvcd__v3_norm(off), radius);
      nearer |= nsvcd__v_lt(between, nsvcd__v_set(*gap + fixed.radius)) << l;
      nsvcd__v_store(gaps + l, between);
      nsvcd__v_store(fraction + l, tau);
    }
    for (; nearer; nearer &= nearer - 1) {
      const size_t l = nsvcd__low_bit(nearer);
      const size_t s = NSVCD__LANES * b + l;
      if (s >= q->segments || !(gaps[l] - fixed.radius < *gap)) continue;
      *gap = gaps[l] - fixed.radius;
      *tick = (double)q->begin[s];
      *tick += (double)fraction[l] * ((double)q->begin[s + 1] - *tick);
      found = 1;
    }
  }
  return found;
}

// The two groups that come nearest to each other; of large bodies, the bodies' own spheres.
static void nsvcd__nearest_groups(const nsvcd__proof *p, nsvcd__search *q,
                                  nsvcd__sphere *moving, nsvcd__sphere *fixed) {
  const nsvcd_body *a = p->moving.body;
  const nsvcd_body *b = p->fixed.body;
  float gap = HUGE_VALF;
  double tick;
  *moving = nsvcd__body_sphere(a);
  *fixed = nsvcd__body_sphere(b);
  for (size_t g = 0; g < nsvcd__body_groups(a) && !nsvcd__is_tiled(a, b); g++) {
    const nsvcd__sphere own = nsvcd__sphere_of(nsvcd__groups_of(a), g);
    nsvcd__chords_in_all(q, own);
    for (size_t h = 0; h < nsvcd__body_groups(b); h++) {
      const nsvcd__sphere other = nsvcd__sphere_of(nsvcd__groups_of(b), h);
      if (!nsvcd__nearest_tick(q, other, &gap, &tick)) continue;
      *moving = own;
      *fixed = other;
    }
  }
}

// The least distance between hull vertices of moving patch i and fixed patch j.
static double nsvcd__vertex_distance(const nsvcd__proof *p, const nsvcd__transform *pose,
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
      least = nsvcd__least_of(least, nsvcd__v3_dot(d, d));
    }
  }
  return sqrt((double)least);
}

// An upper bound of the least distance, from which its search begins: a distance that vertices of
// two patches have, and a little more. The patches, and the time when they are nearest, are found
// in turns. If the bound is within the clearance, triangles of these patches are a contact, which
// is sought there.
static NSVCD__NOINLINE double nsvcd__bound_distance(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  nsvcd__sphere moving, fixed;
  double tick = 0;
  double least = HUGE_VAL;
  double fraction = 0;
  uint32_t from = 0;
  size_t nearest[2] = {0, 0};
  // Bodies that never come near have been told apart without segments.
  nsvcd__cut_segments(p->arcs.motion, p->given.lengths, 0, q);
  nsvcd__nearest_groups(p, q, &moving, &fixed);
  for (size_t turn = 0; turn < NSVCD__TURNS; turn++) {
    float gap = HUGE_VALF;
    double u;
    nsvcd__chords_in_all(q, moving);
    (void)nsvcd__nearest_tick(q, fixed, &gap, &tick);
    const uint32_t first = nsvcd__arc_of(p->arcs.motion, tick, &u);
    const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, first), u);
    const nsvcd__transform pose = nsvcd__transform_of(&at);
    const nsvcd__dtransform back = nsvcd__inverse_dtransform(&at, p->arcs.arc.scale);
    size_t i = 0;
    size_t j = 0;
    for (size_t round = 0; round < 2; round++) {
      const nsvcd__d3 seen = nsvcd__d3_transform(&back, nsvcd__d3_widen(fixed.centre));
      i = nsvcd__patch_near(&p->moving, nsvcd__f3_round(seen));
      moving = nsvcd__sphere_of(nsvcd__body_patches(p->moving.body), i);
      j = nsvcd__patch_near(&p->fixed, nsvcd__f3_transform(&pose, moving.centre));
      fixed = nsvcd__sphere_of(nsvcd__body_patches(p->fixed.body), j);
    }
    const float lengths = p->given.lengths + nsvcd__f3_norm(pose.position);
    const double rounding =
        (double)(4 * NSVCD__ROUNDING * lengths + 2 * nsvcd__errors_of(p, i, j));
    const double apart = 1.0001 * nsvcd__vertex_distance(p, &pose, i, j) + rounding;
    if (!(apart < least)) continue;
    least = apart;
    fraction = u;
    from = first;
    nearest[0] = i;
    nearest[1] = j;
  }
  p->known.has_contact = 0;
  if (!(least <= p->given.clearance)) return least;
  p->goal.clearance = least;
  p->goal.limit = p->work + NSVCD__END_BUDGET;
  (void)nsvcd__find_witness(w, nearest[0], nearest[1], from, fraction);
  return p->known.has_contact ? p->known.found.distance : least;
}
#endif  // NSVCD_NO_PROOF

// ============================================================================= network: an opinion

// ------------------------------------------------------------------------- network/latent_rotation
// In: a rotation R, and a latent. Out: the latent, turned by D(R).
//
// D(R) is block-diagonal: R on degree 1, and the real Wigner matrix on degree 2 (NeuralSVCD,
// appendix E). Its entries are polynomials of R's, so that D(R1 R2) = D(R1) D(R2) to rounding, and
// R may be improper (a mirror).

#ifndef NSVCD_NO_NETWORK
// Numbers of a latent's vectors: (3, CHANNELS), then (5, CHANNELS).
#define NSVCD__VECTORS (8 * NSVCD_W_CHANNELS)
// Numbers of D: (3, 3), then (5, 5).
#define NSVCD__WIGNER 34
// The unit of a stored latent's numbers.
#define NSVCD__LATENT_STEP (1.0f / 127)

// nsvcd__degree2 of a and b, lane by lane: q (5).
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
// is the image of basis vector k, made of products of m's columns.
static NSVCD__NOINLINE void nsvcd__wigner(const nsvcd__vmat3 *m, nsvcd__v scale,
                                          float (*out)[NSVCD__SLICE]) {
  const nsvcd__v third = nsvcd__v_scale(scale, 1.0f / 3);
  const nsvcd__v root = nsvcd__v_scale(scale, 0.5773502691896258f);
  const nsvcd__v twice = nsvcd__v_add(root, root);
  const nsvcd__vmat3 c = nsvcd__vmat3_transpose(*m);
  nsvcd__v xy[5], yz[5], xz[5], xx[5], yy[5], zz[5];
  nsvcd__v3_put(nsvcd__v3_scale(m->x, scale), out[0], NSVCD__SLICE);
  nsvcd__v3_put(nsvcd__v3_scale(m->y, scale), out[3], NSVCD__SLICE);
  nsvcd__v3_put(nsvcd__v3_scale(m->z, scale), out[6], NSVCD__SLICE);
  nsvcd__v_degree2(c.x, c.y, xy);
  nsvcd__v_degree2(c.y, c.z, yz);
  nsvcd__v_degree2(c.x, c.z, xz);
  nsvcd__v_degree2(c.x, c.x, xx);
  nsvcd__v_degree2(c.y, c.y, yy);
  nsvcd__v_degree2(c.z, c.z, zz);
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

// One degree: out (size, CHANNELS) = D (size * size, SLICE) of lane l, times latent (size,
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

// Turns a stored latent by D (WIGNER, SLICE) of lane l, and writes it as latent `slot`, 0 or 1, of
// a row of the decoder's inputs: vectors (2, 8, CHANNELS), then scalars (2, SCALARS).
static NSVCD__O3 NSVCD__NOINLINE void nsvcd__rotate_latent(const int8_t *z,
                                                           float (*turn)[NSVCD__SLICE],
                                                           size_t l, size_t slot, float *row) {
  float *vectors = row + NSVCD__VECTORS * slot;
  float *scalars = row + 2 * NSVCD__VECTORS + NSVCD_W_SCALARS * slot;
  // one degree after the other: a query's stack is deepest here
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
// In: two bodies and a pose. Out: is one inside the other?
//
// A body wholly inside another never crosses its surface, so surfaces cannot tell. The winding
// number of a closed surface can (Jacobson et al. 2013), and far from the surface each patch is as
// good as a dipole of its area vector (Barill et al. 2018):
//   w(x) = sum_i A_i . (p_i - x) / (4 pi |p_i - x|^3)     1 inside, 0 outside
// Differences from Barill et al.: a dipole is at the centre of its ball or sphere, not at the
// centroid of the area, and nothing is of second order.
//
// Near the surface w is wrong: for a flat disc seen from its covering radius it is 0.25 instead of
// 0.146, from half of that 1.0 instead of 0.28. So NSVCD__PROBES patch centres of the inner body
// are candidates, and w is taken at the one that is farthest from the outer patches, in units of
// their radii; as bodies may be of several parts, also at others that are far from it, up to
// NSVCD__INSIDE_SAMPLES in all. None may be nearer than NSVCD__FAR_ENOUGH, or NSVCD__FAR_INSIDE on
// the inner side of a flat patch. If all are on the inner side of the nearest patch, as those of a
// chip in a table top are, they are inside.
//
// Measured at a million points about spheres of 32 to 512 patches, the worst error of w is 0.55
// from 0.75 radii on, 0.52 from 1, and 0.06 from 1.5; from 1 on, fewer than 1 in 1,000 exceed 0.3.
// In bodies of more than a tile's patches the area vectors of groups, and of spheres above them,
// are summed, and the sum stands for the members of a sphere that is farther than NSVCD__DIPOLE of
// its radii: w is then within 0.05 of the sum over all patches (tests/test_level.c).
//
// Cost: at most NSVCD__PROBES * N distances for each of the two bodies, if centres of one are in
// the other's sphere and a ray out of it is blocked; of large bodies only those to groups nearby.

#ifndef NSVCD_NO_NETWORK
#define NSVCD__PROBES NSVCD__LANES  // patch centres of the inner body
// Distances in radii of a patch. w may be taken at a probe if no patch is nearer than this,
#define NSVCD__FAR_ENOUGH 1.0f
// or than this, on the inner side of the nearest one.
#define NSVCD__FAR_INSIDE 0.6f
// Patches beyond this do not matter.
#define NSVCD__AMPLE 2.0f
// The patches of a sphere count as one dipole beyond this, in radii of the sphere.
#define NSVCD__DIPOLE 3.0f
// A patch is flat if its area vector is at least this share of its ball's largest disc.
#define NSVCD__FLAT 0.4f
#define NSVCD__INSIDE_SAMPLES 4  // winding numbers, at most

// A filter of a traversal: spheres whose members may be nearer to one of the probes than
// NSVCD__AMPLE of their radii. what: the sphere about the probes. A member (p, r) of a sphere
// (c, R) has |p - c| + r <= R, so that |p - x| / r is at least |c - x| / R.
static uint32_t nsvcd__may_be_close(const void *what, nsvcd__spheres all) {
  const nsvcd__sphere *about = (const nsvcd__sphere *)what;
  const nsvcd__v radius = nsvcd__v_set(about->radius);
  uint32_t close = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 centre = nsvcd__v3_set(about->centre);
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), centre);
    const nsvcd__v r = nsvcd__v_load(all.r + l);
    const nsvcd__v ample = nsvcd__v_fma(r, nsvcd__v_set(NSVCD__AMPLE), radius);
    close |= nsvcd__v_le(nsvcd__v3_dot(d, d), nsvcd__v_signed_square(ample)) << l;
  }
  return close;
}

// Points, and how they are situated about a body.
typedef struct nsvcd__probes {
  float at[3][NSVCD__PROBES];
  // the least |p_i - x| / r_i over its patches, squared; at most AMPLE squared
  float square[NSVCD__PROBES];
  // the squared distance of the nearest patch, taken as a disc of its area, and the height over it:
  // negative on the inner side, if the patch is flat
  float nearest[NSVCD__PROBES], height[NSVCD__PROBES];
} nsvcd__probes;

// Fills in all but `at`, from that.
static void nsvcd__probes_measure(const nsvcd_body *body, nsvcd__probes *out) {
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  const nsvcd__v zero = nsvcd__v_set(0);
  nsvcd__f3 low = nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF);
  nsvcd__f3 high = nsvcd__f3_scale(low, -1);
  nsvcd__traversal traversal;
  size_t g;
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    low = nsvcd__f3_min(low, nsvcd__lane_of(out->at, k));
    high = nsvcd__f3_max(high, nsvcd__lane_of(out->at, k));
    out->square[k] = NSVCD__AMPLE * NSVCD__AMPLE;
    out->nearest[k] = HUGE_VALF;
    out->height[k] = 0;
  }
  nsvcd__sphere over;
  over.centre = nsvcd__f3_add(nsvcd__f3_scale(low, 0.5f), nsvcd__f3_scale(high, 0.5f));
  over.radius = nsvcd__f3_norm(nsvcd__f3_sub(high, over.centre));
  nsvcd__traversal_begin(&traversal, body, nsvcd__may_be_close, &over);
  while (nsvcd__traversal_next(&traversal, &g)) {
    const size_t next = NSVCD__GROUP * (g + 1);
    const size_t end = next < body->patches ? next : body->patches;
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v3 at = nsvcd__v3_load(out->at, l);
      nsvcd__v least = nsvcd__v_load(out->square + l);
      nsvcd__v nearest = nsvcd__v_load(out->nearest + l);
      nsvcd__v height = nsvcd__v_load(out->height + l);
      for (size_t i = NSVCD__GROUP * g; i < end; i++) {
        const nsvcd__sphere patch = nsvcd__sphere_of(patches, i);
        const nsvcd__f3 area = nsvcd__f3_get(nsvcd__body_areas(body) + i, body->padded);
        const float size = nsvcd__f3_norm(area);
        const nsvcd__f3 normal = nsvcd__f3_scale(area, size > 0 ? 1 / size : 0);
        const nsvcd__v3 d = nsvcd__v3_sub(at, nsvcd__v3_set(patch.centre));
        const nsvcd__v square = nsvcd__v3_dot(d, d);
        const float own = patch.radius * patch.radius;
        const float inverse = 1 / (own > 1e-37f ? own : 1e-37f);
        least = nsvcd__v_min(least, nsvcd__v_scale(square, inverse));
        const nsvcd__v above = nsvcd__v3_dot(d, nsvcd__v3_set(normal));
        const nsvcd__v above2 = nsvcd__v_mul(above, above);
        const nsvcd__v aside2 = nsvcd__v_max(nsvcd__v_sub(square, above2), zero);
        const nsvcd__v radius = nsvcd__v_set(sqrtf(size * 0.3183f));
        const nsvcd__v aside = nsvcd__v_sqrt(aside2);
        const nsvcd__v off = nsvcd__v_max(nsvcd__v_sub(aside, radius), zero);
        const nsvcd__v to_disc = nsvcd__v_fma(off, off, above2);
        const int flat = size > NSVCD__FLAT * 3.1416f * own;
        height = nsvcd__v_pick(nearest, to_disc, height, flat ? above : nsvcd__v_abs(above));
        nearest = nsvcd__v_min(nearest, to_disc);
      }
      nsvcd__v_store(out->square + l, least);
      nsvcd__v_store(out->nearest + l, nearest);
      nsvcd__v_store(out->height + l, height);
    }
  }
}

// Adds to the lanes the terms of the winding number at `point` of `count` spheres, a multiple of
// 16, from `first` on. n: 0 for patches; else for level n - 1, 64 spheres at most. A sphere that is
// too close to the point leaves its term to its members.
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
      const nsvcd__v3 area = nsvcd__v3_get(areas + first + i, stride);
      const nsvcd__v length = nsvcd__v_max(nsvcd__v3_norm(d), nsvcd__v_set(1e-30f));
      const nsvcd__v inverse = nsvcd__v_div(nsvcd__v_set(1), length);
      // one factor at a time, for the cube may overflow
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
  nsvcd__add_dipoles(body, top ? top + 1 : 0, 0, top ? slots : body->padded, point, lanes);
  // in this order, however wide a slice is
  for (size_t l = 0; l < NSVCD__LANES; l++) total += lanes[l];
  return total / 12.5663706f;
}

// Of the probes that are far enough from the surface, the one that is farthest from those marked;
// PROBES if there is none.
static size_t nsvcd__next_probe(nsvcd__probes *probes, uint32_t marked) {
  size_t next = NSVCD__PROBES;
  float most = -1;
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    float least = probes->square[k];
    const float needed = probes->height[k] < 0 ? NSVCD__FAR_INSIDE : NSVCD__FAR_ENOUGH;
    if (least < needed * needed || marked >> k & 1) continue;
    for (uint32_t left = marked; left; left &= left - 1) {
      const nsvcd__f3 other = nsvcd__lane_of(probes->at, nsvcd__low_bit(left));
      const nsvcd__f3 d = nsvcd__f3_sub(nsvcd__lane_of(probes->at, k), other);
      const float square = nsvcd__f3_dot(d, d);
      least = square < least || left == marked ? square : least;
    }
    if (least > most) next = k;
    most = least > most ? least : most;
  }
  return next;
}

// Does the ray from a point away from a body's centre meet the ball of a patch? If not, the point
// is outside: from inside the ray would cross the surface.
static int nsvcd__exit_is_blocked(const nsvcd_body *body, nsvcd__f3 point) {
  const nsvcd__f3 away = nsvcd__f3_sub(point, nsvcd__f3_load(body->centre));
  const float length = nsvcd__f3_norm(away);
  const nsvcd__f3 along = nsvcd__f3_scale(away, length > 0 ? 1 / length : 0);
  const nsvcd__beam out = {point, along, NSVCD__ROUNDING * body->extent};
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  nsvcd__traversal traversal;
  size_t g;
  nsvcd__traversal_begin(&traversal, body, nsvcd__is_on_beam, &out);
  while (nsvcd__traversal_next(&traversal, &g)) {
    if (nsvcd__is_on_beam(&out, nsvcd__spheres_from(patches, NSVCD__GROUP * g))) return 1;
  }
  return 0;
}

// Is `inner`, scaled and posed in the frame of `outer`, or a part of it, inside of that?
static int nsvcd__is_contained_in(const nsvcd_body *inner, const nsvcd_body *outer,
                                  float scale, const nsvcd__transform *pose) {
  const nsvcd__spheres patches = nsvcd__body_patches(inner);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_load(outer->centre));
  nsvcd__probes probes;
  uint32_t inside = 0;
  uint32_t marked = 0;
  uint32_t below = 0;
  if (outer->open) return 0;
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    // Neighbours are stored together, so that equal steps cover the body.
    const nsvcd__f3 own = nsvcd__centre_of(patches, k * inner->patches / NSVCD__PROBES);
    const nsvcd__f3 turned = nsvcd__mat3_apply(&pose->rotation, own);
    const nsvcd__f3 at = nsvcd__f3_add(nsvcd__f3_scale(turned, scale), pose->position);
    nsvcd__lane_set(at, probes.at, k);
  }
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 off = nsvcd__v3_sub(nsvcd__v3_load(probes.at, l), centre);
    inside |= nsvcd__v_le(nsvcd__v3_norm(off), nsvcd__v_set(outer->radius)) << l;
  }
  for (uint32_t left = inside; left; left &= left - 1) {
    const size_t k = nsvcd__low_bit(left);
    if (!nsvcd__exit_is_blocked(outer, nsvcd__lane_of(probes.at, k))) inside &= ~(1u << k);
  }
  if (!inside) return 0;
  nsvcd__probes_measure(outer, &probes);
  for (size_t k = 0; k < NSVCD__PROBES; k++) {
    if (!(inside >> k & 1)) probes.square[k] = 0;
    below |= (uint32_t)(probes.height[k] < 0) << k;
  }
  // all on the inner side, however near
  if (inside == 0xffff && below == 0xffff) return 1;
  for (size_t n = 0; n < NSVCD__INSIDE_SAMPLES; n++) {
    const size_t k = nsvcd__next_probe(&probes, marked);
    if (k == NSVCD__PROBES) break;
    marked |= 1u << k;
    // -1 if the mesh is inside out
    if (fabsf(nsvcd__winding_number(outer, nsvcd__lane_of(probes.at, k))) > 0.5f) return 1;
  }
  return 0;
}

// Is one body, or a part of it, inside of the other, with the moving one scaled and posed in the
// fixed frame?
static int nsvcd__is_contained(const nsvcd_body *moving, const nsvcd_body *fixed, float scale,
                               const nsvcd__transform *pose) {
  nsvcd__transform back;
  back.rotation = nsvcd__mat3_transpose(pose->rotation);
  const nsvcd__f3 from = nsvcd__mat3_apply(&back.rotation, pose->position);
  back.position = nsvcd__f3_of(-from.x / scale, -from.y / scale, -from.z / scale);
  return nsvcd__is_contained_in(moving, fixed, scale, pose) ||
         nsvcd__is_contained_in(fixed, moving, 1 / scale, &back);
}
#endif  // NSVCD_NO_NETWORK

// ----------------------------------------------------------------------------------- network/pairs
// In: candidates, and the motion. Out: pairs of patches in the fixed body's frame: where they are
// halfway through the interval in which their balls meet, and how they move, linearised about that
// time. A slice of candidates at a time, one per lane.

#ifndef NSVCD_NO_NETWORK
// A slice of pairs, in the fixed body's frame; first the moving patch, then the fixed one.
typedef struct nsvcd__pairs {
  nsvcd__v3 p1, p2;       // centres at mid-interval
  nsvcd__v r1, r2;        // radii of the balls
  nsvcd__vmat3 rotation;  // of the moving body at mid-interval
  // half the displacement of the point midway between p1 and p2, moving with the moving body
  nsvcd__v3 v;
  nsvcd__v3 w;          // half the rotation vector
  nsvcd__v3 normal[2];  // in the bodies' frames, of unit length, or 0 if a patch has none
  nsvcd__v flat[2];     // length of the area vector over the area of the ball's largest disc
  const int8_t *z[2][NSVCD__SLICE];         // latents
  const int8_t *extremes[2][NSVCD__SLICE];  // (EXTREMES, 3) at a stride of GROUP
} nsvcd__pairs;

// Half the rotation vector of a unit quaternion, from the sine s of half the angle: asin(s) / s
// times its vector part.
static nsvcd__v3 nsvcd__v_half_rotation(nsvcd__vquat q) {
  // asin(s) / s in powers of s^2, from the highest on: to 2e-6 for s < 0.5
  static const float series[5] = {0.03038194f, 0.04464286f, 0.075f, 0.16666667f, 1};
  const nsvcd__v3 axis = nsvcd__vquat_axis(q);
  const nsvcd__v sign = nsvcd__v_sign(q.w);
  const nsvcd__v square = nsvcd__v3_dot(axis, axis);
  nsvcd__v ratio = nsvcd__v_set(0.02237216f);
  for (size_t k = 0; k < 5; k++) ratio = nsvcd__v_fma(ratio, square, nsvcd__v_set(series[k]));
  // more than 60 degrees, as in a motion of few poses
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
// positions of the pivot relative to an origin.
static nsvcd__v_pose nsvcd__track_poses_at(const nsvcd__track *track, const float *t,
                                           size_t count, nsvcd__f3 origin) {
  float fraction[NSVCD__SLICE] = {0};
  float rotation[4 * NSVCD__SLICE] = {0};
  float turned[4 * NSVCD__SLICE] = {0};
  float position[3 * NSVCD__SLICE] = {0};
  float moved[3 * NSVCD__SLICE] = {0};
  const int moves = track->count > 1;
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  for (size_t l = count; l < NSVCD__SLICE; l++) rotation[3 * NSVCD__SLICE + l] = 1;
  for (size_t l = 0; l < count; l++) {
    const size_t k = moves ? nsvcd__pose_at(track, t[l], &fraction[l]) : 0;
    const nsvcd_pose *a = &track->poses[k];
    const nsvcd_pose *b = moves ? a + 1 : a;
    const nsvcd__f3 from = nsvcd__f3_round(nsvcd__pivot_of(a, pivot));
    const nsvcd__f3 to = nsvcd__f3_round(nsvcd__pivot_of(b, pivot));
    nsvcd__quat q = nsvcd__quat_load(a->rotation);
    const nsvcd__quat next = nsvcd__quat_load(b->rotation);
    const float cosine = nsvcd__quat_dot(q, next);
    const float sign = cosine < 0 ? -1.0f : 1.0f;
    const nsvcd__quat chord = nsvcd__quat_fma(-1, q, nsvcd__quat_scale(next, sign));
    // Up to 5 degrees the chord, scaled to unit length, is the slerp to 2e-6 radians.
    if (fabsf(cosine) < 0.999f)
      q = nsvcd__quat_slerp(q, next, fraction[l]);
    else
      nsvcd__quat_put(chord, turned + l, NSVCD__SLICE);
    nsvcd__quat_put(q, rotation + l, NSVCD__SLICE);
    nsvcd__f3_put(nsvcd__f3_sub(from, origin), position + l, NSVCD__SLICE);
    nsvcd__f3_put(nsvcd__f3_sub(to, from), moved + l, NSVCD__SLICE);
  }
  const nsvcd__v u = nsvcd__v_load(fraction);
  const nsvcd__vquat start = nsvcd__vquat_load(rotation, NSVCD__SLICE);
  const nsvcd__vquat chord = nsvcd__vquat_load(turned, NSVCD__SLICE);
  const nsvcd__v3 travel = nsvcd__v3_get(moved, NSVCD__SLICE);
  nsvcd__v_pose out;
  out.rotation = nsvcd__vquat_unit(nsvcd__vquat_fma(u, chord, start));
  out.position = nsvcd__v3_fma(u, travel, nsvcd__v3_get(position, NSVCD__SLICE));
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

// Where pairs are at mid-interval, and how they move: from the centres (3, SLICE) of the moving
// patches, and the poses at entry, at exit, and halfway. A function of its own, so that its stack
// does not add to that of nsvcd__v_poses_at.
static NSVCD__NOINLINE void nsvcd__pairs_in_passing(const nsvcd__v_pose *at,
                                                    const float *centres, nsvcd__pairs *p) {
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__v3 centre = nsvcd__v3_get(centres, NSVCD__SLICE);
  const nsvcd__v3 arm1 = nsvcd__vmat3_apply(nsvcd__vmat3_of(at[0].rotation), centre);
  const nsvcd__v3 arm2 = nsvcd__vmat3_apply(nsvcd__vmat3_of(at[1].rotation), centre);
  const nsvcd__v3 moved = nsvcd__v3_sub(at[1].position, at[0].position);
  const nsvcd__v3 step = nsvcd__v3_add(nsvcd__v3_sub(arm2, arm1), moved);
  const nsvcd__vquat back = nsvcd__vquat_inverse(at[0].rotation);
  p->w = nsvcd__v_half_rotation(nsvcd__vquat_mul(at[1].rotation, back));
  p->rotation = nsvcd__vmat3_of(at[2].rotation);
  const nsvcd__v3 turned = nsvcd__vmat3_apply(p->rotation, centre);
  p->p1 = nsvcd__v3_add(turned, at[2].position);
  const nsvcd__v3 arm = nsvcd__v3_scale(nsvcd__v3_sub(p->p2, p->p1), half);
  p->v = nsvcd__v3_fma(half, step, nsvcd__v3_cross(p->w, arm));
}

// The pairs of `count` candidates, 1 to SLICE. The other lanes do not matter.
static NSVCD__NOINLINE void nsvcd__pairs_of(const nsvcd_body *moving, const nsvcd_body *fixed,
                                            const nsvcd__motion *motion,
                                            nsvcd__candidate *const *candidates, size_t count,
                                            nsvcd__pairs *p) {
  // entry, exit, and halfway
  float times[3][NSVCD__SLICE];
  nsvcd__v_pose at[3];
  float centres[2][3 * NSVCD__SLICE] = {{0}, {0}};
  float radii[2][NSVCD__SLICE] = {{0}, {0}};
  float normals[2][3 * NSVCD__SLICE] = {{0}, {0}};
  float flat[2][NSVCD__SLICE] = {{0}, {0}};
  for (size_t l = 0; l < count; l++) {
    const nsvcd__candidate *c = candidates[l];
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_body *body = n == 0 ? moving : fixed;
      const size_t i = n == 0 ? c->moving : c->fixed;
      const float scale = n == 0 ? motion->scale : 1;
      const nsvcd__sphere patch = nsvcd__sphere_of(nsvcd__body_patches(body), i);
      nsvcd__f3_put(nsvcd__f3_scale(patch.centre, scale), centres[n] + l, NSVCD__SLICE);
      radii[n][l] = scale * patch.radius;
      p->z[n][l] = nsvcd__body_latents(body) + NSVCD__LATENT * i;
      p->extremes[n][l] = nsvcd__group_extremes(body, i / NSVCD__GROUP) + i % NSVCD__GROUP;
      // A closed patch has no normal. A body that was loaded may hold any numbers.
      const float inverse = patch.radius > 0 ? 1 / patch.radius : 0;
      const nsvcd__f3 area = nsvcd__f3_get(nsvcd__body_areas(body) + i, body->padded);
      const float most = fmaxf(fmaxf(fabsf(area.x), fabsf(area.y)), fabsf(area.z));
      const nsvcd__f3 even = nsvcd__f3_scale(area, most > 1e-37f ? 1 / most : 0);
      const float length = nsvcd__f3_norm(even);
      const float fraction = most * inverse * (length * inverse);
      const nsvcd__f3 normal = nsvcd__f3_scale(even, fraction > 1e-6f ? 1 / length : 0);
      nsvcd__f3_put(normal, normals[n] + l, NSVCD__SLICE);
      flat[n][l] = fminf(0.31830989f * fraction, 2);
    }
    times[0][l] = c->t_enter;
    times[1][l] = c->t_exit;
    times[2][l] = 0.5f * (c->t_enter + c->t_exit);
  }
  p->p2 = nsvcd__v3_get(centres[1], NSVCD__SLICE);
  p->r1 = nsvcd__v_load(radii[0]);
  p->r2 = nsvcd__v_load(radii[1]);
  for (size_t n = 0; n < 2; n++) {
    p->normal[n] = nsvcd__v3_get(normals[n], NSVCD__SLICE);
    p->flat[n] = nsvcd__v_load(flat[n]);
  }
  for (size_t k = 0; k < 3; k++) at[k] = nsvcd__v_poses_at(motion, times[k], count);
  nsvcd__pairs_in_passing(at, centres[0], p);
}
#endif  // NSVCD_NO_NETWORK

// ------------------------------------------------------------------------------ network/invariants
// In: pairs of patches in motion. Out: the decoder's inputs, invariants (n, DECODER_IN).
//
// All is expressed in a frame that moves with the pair, in units of r1 + r2 (NeuralSVCD, appendix
// F), so that the logit is invariant to rigid motion and scale. The other symmetries are not
// learned, but removed by conventions:
//   swap           the larger patch comes first
//   axis 1         the line between the centres
//   axis 2         the velocity across the line, plus a twentieth of the lean (the difference of
//                  the patches' normals), so that it has a limit where the velocity vanishes
//   time reversal  time runs so that velocity and lean, across the line, do not oppose each other
//   mirror         axis 3 points to the side of the lean; if the lean is on neither side, as for a
//                  pair at rest, the frame is right-handed
// Degenerate cases: if the centres coincide (to 1e-5 of r1 + r2), axis 1 is the lean, else x; if
// the reference for axis 2 vanishes, that is the coordinate axis farthest from axis 1.
//
// Pairs become inputs a slice at a time, one per lane; only latents are turned pair by pair,
// channels side by side.

#ifndef NSVCD_NO_NETWORK
// A lean that is this near to the plane of axes 1 and 2 is on neither side.
#define NSVCD__SIDE 1e-4f

// ---- frames and facts

// Pairs in their own units, in the fixed body's axes, and their frames.
typedef struct nsvcd__views {
  nsvcd__v inverse, k1, k2;  // 1 / (r1 + r2), and the radii
  nsvcd__v swap;             // -1 if the fixed patch is the larger, else 1
  nsvcd__v3 d;               // from the larger patch's centre to the smaller one's
  nsvcd__v3 lean;
  nsvcd__v3 normal;    // the moving patch's
  nsvcd__v time;       // -1 if time runs backwards, else 1
  nsvcd__v3 v, w;      // the larger patch's motion, as time runs
  nsvcd__vmat3 frame;  // its rows are the axes
  nsvcd__v side;       // -1 if mirrored, else 1
} nsvcd__views;

// a without its part along the unit vector e.
static nsvcd__v3 nsvcd__v_across(nsvcd__v3 a, nsvcd__v3 e) {
  return nsvcd__v3_fma(nsvcd__v_negate(nsvcd__v3_dot(a, e)), e, a);
}

// x where a <= b, elsewhere y.
static nsvcd__v3 nsvcd__v3_pick(nsvcd__v a, nsvcd__v b, nsvcd__v3 x, nsvcd__v3 y) {
  return nsvcd__v3_of(nsvcd__v_pick(a, b, x.x, y.x), nsvcd__v_pick(a, b, x.y, y.y),
                      nsvcd__v_pick(a, b, x.z, y.z));
}

// a over its length where that exceeds `least`, elsewhere `instead`.
static nsvcd__v3 nsvcd__v_unit_or(nsvcd__v3 a, float least, nsvcd__v3 instead) {
  const nsvcd__v length = nsvcd__v3_norm(a);
  const nsvcd__v floor = nsvcd__v_set(least);
  const nsvcd__v inverse = nsvcd__v_div(nsvcd__v_set(1), nsvcd__v_max(length, floor));
  return nsvcd__v3_pick(length, floor, instead, nsvcd__v3_scale(a, inverse));
}

static NSVCD__NOINLINE void nsvcd__views_of(const nsvcd__pairs *p, nsvcd__views *view) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v minus = nsvcd__v_set(-1);
  const nsvcd__v3 between = nsvcd__v3_sub(p->p2, p->p1);
  // The unit of length: r1 + r2, or, between two points, what keeps the inputs finite.
  const nsvcd__v lengths = nsvcd__v_add(nsvcd__v3_norm(between), nsvcd__v3_norm(p->v));
  const nsvcd__v least = nsvcd__v_fma(nsvcd__v_set(1e-6f), lengths, nsvcd__v_set(1e-30f));
  const nsvcd__v unit = nsvcd__v_max(nsvcd__v_add(p->r1, p->r2), least);
  const nsvcd__v inverse = nsvcd__v_div(one, unit);
  view->inverse = inverse;
  view->k1 = nsvcd__v_mul(p->r1, inverse);
  view->k2 = nsvcd__v_mul(p->r2, inverse);
  view->swap = nsvcd__v_pick(p->r2, p->r1, one, minus);
  // The larger patch's motion changes its sign with `swap`, and again with `time`: in all with
  // `sign` below.
  view->normal = nsvcd__vmat3_apply(p->rotation, p->normal[0]);
  const nsvcd__v3 lean1 = nsvcd__v3_scale(view->normal, view->k1);
  const nsvcd__v3 lean2 = nsvcd__v3_scale(p->normal[1], view->k2);
  const nsvcd__v3 lean = nsvcd__v3_scale(nsvcd__v3_sub(lean1, lean2), view->swap);
  const nsvcd__v3 v = nsvcd__v3_scale(p->v, inverse);
  view->lean = lean;
  view->d = nsvcd__v3_scale(nsvcd__v3_scale(between, inverse), view->swap);

  // the frames, and the direction of time
  const nsvcd__v3 x_axis = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v3 line = nsvcd__v3_of(nsvcd__v_plus(lean.x, 1e-6f), lean.y, lean.z);
  nsvcd__v3 instead = nsvcd__v_unit_or(line, 1e-9f, x_axis);
  const nsvcd__v3 e1 = nsvcd__v_unit_or(view->d, 1e-5f, instead);
  const nsvcd__v3 lean_across = nsvcd__v_across(lean, e1);
  const nsvcd__v3 v_across = nsvcd__v_across(v, e1);
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__v3_dot(lean_across, v_across));
  view->time = nsvcd__v_mul(sign, view->swap);
  view->v = nsvcd__v3_scale(v, sign);
  view->w = nsvcd__v3_scale(p->w, sign);
  const nsvcd__v3 forward = nsvcd__v3_scale(v_across, sign);
  const nsvcd__v3 ref = nsvcd__v3_fma(nsvcd__v_set(NSVCD__LEAN), lean_across, forward);
  // if the reference vanishes in some lane: the coordinate axis farthest from e1
  if (nsvcd__v_le(nsvcd__v3_norm(ref), nsvcd__v_set(1e-7f))) {
    const nsvcd__v3 y_axis = nsvcd__v3_set(nsvcd__f3_of(0, 1, 0));
    const nsvcd__v3 z_axis = nsvcd__v3_set(nsvcd__f3_of(0, 0, 1));
    const nsvcd__v3 size = nsvcd__v3_max(e1, nsvcd__v3_negate(e1));
    const nsvcd__v rest = nsvcd__v_min(size.y, size.z);
    const nsvcd__v3 y_or_z = nsvcd__v3_pick(size.y, size.z, y_axis, z_axis);
    const nsvcd__v3 axis = nsvcd__v3_pick(size.x, rest, x_axis, y_or_z);
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

// ---- gaps

// The axes u (GAPS) along which gaps are measured.
static void nsvcd__gap_axes_of(const nsvcd__pairs *p, const nsvcd__views *view, nsvcd__v3 *u) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v3 between = nsvcd__v3_sub(p->p1, p->p2);
  const nsvcd__v3 x_axis = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v3 line = nsvcd__v_unit_or(between, 1e-20f, x_axis);
  const nsvcd__v3 fixed = nsvcd__v_unit_or(p->normal[1], 0.5f, line);
  const nsvcd__v3 moving = nsvcd__v_unit_or(nsvcd__v3_negate(view->normal), 0.5f, line);
  u[NSVCD__GAP_LARGER] = nsvcd__v3_pick(zero, view->swap, moving, fixed);
  u[NSVCD__GAP_SMALLER] = nsvcd__v3_pick(zero, view->swap, fixed, moving);
  u[NSVCD__GAP_LINE] = line;
  u[NSVCD__GAP_BOTH] = nsvcd__v_unit_or(nsvcd__v3_add(fixed, moving), 1e-3f, line);
}

// The extreme points of the first `count` pairs of a slice, of the moving patches and of the fixed
// ones: (2, EXTREMES, 3, SLICE), from the centres, in the bodies' frames, in 1/127 of the radii.
static void nsvcd__extremes_collect(const nsvcd__pairs *p, size_t count, int8_t *extremes) {
  memset(extremes, 0, 2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE);
  for (size_t n = 0; n < 2; n++) {
    for (size_t k = 0; k < 3 * NSVCD__EXTREMES; k++, extremes += NSVCD__SLICE) {
      for (size_t l = 0; l < count; l++) extremes[l] = p->extremes[n][l][NSVCD__GROUP * k];
    }
  }
}

// The direction u as seen from a patch that turns by w, to the second order: its dot product with q
// is u . (q + w x q + w x (w x q) / 2).
static nsvcd__v3 nsvcd__turned_back(nsvcd__v3 u, nsvcd__v3 w) {
  const nsvcd__v along = nsvcd__v_scale(nsvcd__v3_dot(u, w), 0.5f);
  const nsvcd__v less = nsvcd__v_scale(nsvcd__v3_dot(w, w), -0.5f);
  const nsvcd__v3 turned = nsvcd__v3_add(nsvcd__v3_cross(u, w), u);
  return nsvcd__v3_fma(less, u, nsvcd__v3_fma(along, w, turned));
}

// The gaps along the axes u at tau, wide (GAPS), in the fixed body's units; the interval's ends are
// -1 and 1. Seen from a frame that turns half as fast as the moving patch, so that both patches are
// treated alike: the line between the centres moves by v, one patch turns by w / 2, the other by
// -w / 2. extremes: of nsvcd__extremes_collect.
static NSVCD__NOINLINE void nsvcd__gaps_at(const nsvcd__pairs *p, const nsvcd__v3 *u,
                                           const int8_t *extremes, nsvcd__v tau,
                                           nsvcd__v *wide) {
  const size_t size = 3 * NSVCD__SLICE;
  const nsvcd__v3 half = nsvcd__v3_scale(p->w, nsvcd__v_scale(tau, 0.5f));
  const nsvcd__v3 back = nsvcd__v3_negate(half);
  nsvcd__v3 own[NSVCD__GAPS], other[NSVCD__GAPS];
  nsvcd__v low[NSVCD__GAPS], high[NSVCD__GAPS];
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__v3 turned = nsvcd__turned_back(u[d], half);
    own[d] = nsvcd__vmat3_apply_transpose(p->rotation, turned);
    other[d] = nsvcd__turned_back(u[d], back);
    low[d] = nsvcd__v_set(1e30f);
    high[d] = nsvcd__v_set(-1e30f);
  }
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += size) {
    const nsvcd__v3 q = nsvcd__v3_load_int8(extremes, NSVCD__SLICE);
    const nsvcd__v3 x = nsvcd__v3_load_int8(extremes + NSVCD__EXTREMES * size, NSVCD__SLICE);
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      low[d] = nsvcd__v_min(low[d], nsvcd__v3_dot(own[d], q));
      high[d] = nsvcd__v_max(high[d], nsvcd__v3_dot(other[d], x));
    }
  }
  const nsvcd__v3 between = nsvcd__v3_sub(p->p1, p->p2);
  const nsvcd__v3 line = nsvcd__v3_fma(tau, p->v, between);
  const nsvcd__v step1 = nsvcd__v_scale(p->r1, 1.0f / 127);
  const nsvcd__v step2 = nsvcd__v_scale(p->r2, 1.0f / 127);
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__v above = nsvcd__v_fma(step1, low[d], nsvcd__v3_dot(u[d], line));
    wide[d] = nsvcd__v_sub(above, nsvcd__v_mul(step2, high[d]));
  }
}

// The fact about a gap.
static nsvcd__v nsvcd__gap_fact(nsvcd__v gap, float steep) {
  const nsvcd__v x = nsvcd__v_scale(gap, steep);
  return nsvcd__v_div(x, nsvcd__v_plus(nsvcd__v_abs(x), 1));
}

// Writes the facts about gaps.
static NSVCD__NOINLINE void nsvcd__gap_facts(const nsvcd__pairs *p, const nsvcd__views *view,
                                             size_t count, float (*facts)[NSVCD__SLICE]) {
  int8_t extremes[2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE];
  nsvcd__v3 u[NSVCD__GAPS];
  nsvcd__gap_axes_of(p, view, u);
  nsvcd__extremes_collect(p, count, extremes);
  for (size_t m = 0; m < NSVCD__MOMENTS; m++) {
    const nsvcd__v tau = nsvcd__v_scale(view->time, (float)m - 1);
    nsvcd__v wide[NSVCD__GAPS];
    nsvcd__v widest = nsvcd__v_set(-1e30f);
    nsvcd__gaps_at(p, u, extremes, tau, wide);
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      const nsvcd__v gap = nsvcd__v_mul(view->inverse, wide[d]);
      float *to = facts[NSVCD__FACT_GAPS + NSVCD__MOMENTS * d + m];
      nsvcd__v_store(to, nsvcd__gap_fact(gap, NSVCD__GAP_STEEP));
      widest = nsvcd__v_max(widest, gap);
    }
    nsvcd__v_store(facts[NSVCD__FACT_WIDEST + m],
                   nsvcd__gap_fact(widest, NSVCD__WIDEST_STEEP));
  }
}

// ---- inputs

// What inputs for a slice of pairs are made of, besides the latents.
typedef struct nsvcd__inputs {
  // of the moving patches and of the fixed ones:
  nsvcd__vmat3 turn[2];  // from their bodies' frames to the pairs'
  nsvcd__v k[2];         // radii, in the pairs' units
  uint32_t keep;         // lanes in which the moving patch is the larger
  float facts[NSVCD__FACTS][NSVCD__SLICE];
} nsvcd__inputs;

// All of that but for the facts about gaps.
static NSVCD__NOINLINE void nsvcd__inputs_without_gaps(const nsvcd__pairs *p,
                                                       const nsvcd__views *view,
                                                       nsvcd__inputs *out) {
  out->turn[0] = nsvcd__vmat3_mul(view->frame, p->rotation);
  out->turn[1] = view->frame;
  out->k[0] = view->k1;
  out->k[1] = view->k2;
  out->keep = nsvcd__v_le(nsvcd__v_set(0), view->swap);

  const nsvcd__v speed2 = nsvcd__v3_dot(view->v, view->v);
  const nsvcd__v above = nsvcd__v_plus(speed2, 1e-6f);
  // the time of the centres' closest approach, in half intervals
  const nsvcd__v when = nsvcd__v_div(nsvcd__v3_dot(view->d, view->v), above);
  const nsvcd__v tau = nsvcd__v_clamp(when, -1, 1);
  const nsvcd__v3 closest = nsvcd__v3_sub(view->d, nsvcd__v3_scale(view->v, tau));
  const nsvcd__v3 velocity = nsvcd__vmat3_apply(view->frame, view->v);
  const nsvcd__v3 turn = nsvcd__vmat3_apply(view->frame, view->w);
  // the turn is an axial vector
  const nsvcd__v3 mirrored = nsvcd__v3_scale(turn, view->side);

  float(*facts)[NSVCD__SLICE] = out->facts;
  nsvcd__v_store(facts[NSVCD__FACT_DISTANCE], nsvcd__v3_norm(view->d));
  nsvcd__v_store(facts[NSVCD__FACT_RADIUS], nsvcd__v_max(view->k1, view->k2));
  nsvcd__v_store(facts[NSVCD__FACT_CLOSEST], nsvcd__v3_norm(closest));
  nsvcd__v_store(facts[NSVCD__FACT_TAU], tau);
  nsvcd__v3_put(velocity, facts[NSVCD__FACT_VELOCITY], NSVCD__SLICE);
  nsvcd__v3_put(mirrored, facts[NSVCD__FACT_TURN], NSVCD__SLICE);
  nsvcd__v_store(facts[NSVCD__FACT_SPEED], nsvcd__v_sqrt(speed2));
  nsvcd__v_store(facts[NSVCD__FACT_SPIN], nsvcd__v3_norm(view->w));

  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v3 *fixed = &p->normal[1];
  const nsvcd__v3 larger = nsvcd__v3_pick(zero, view->swap, view->normal, *fixed);
  const nsvcd__v3 smaller = nsvcd__v3_pick(zero, view->swap, *fixed, view->normal);
  float(*facing)[NSVCD__SLICE] = facts + NSVCD__FACT_FACING;
  nsvcd__v_store(facing[0], nsvcd__v3_dot(larger, smaller));
  nsvcd__v_store(facing[1], nsvcd__v3_dot(larger, view->frame.x));
  nsvcd__v_store(facing[2], nsvcd__v3_dot(smaller, view->frame.x));
  float(*flat)[NSVCD__SLICE] = facts + NSVCD__FACT_FLAT;
  nsvcd__v_store(flat[0], nsvcd__v_pick(zero, view->swap, p->flat[0], p->flat[1]));
  nsvcd__v_store(flat[1], nsvcd__v_pick(zero, view->swap, p->flat[1], p->flat[0]));
}

// For the first `count` pairs of a slice. Step by step, so that the stack of one step does not add
// to that of the next.
static void nsvcd__inputs_of(const nsvcd__pairs *p, size_t count, nsvcd__inputs *out) {
  nsvcd__views view;
  nsvcd__views_of(p, &view);
  nsvcd__inputs_without_gaps(p, &view, out);
  nsvcd__gap_facts(p, &view, count, out->facts);
}

// Writes the decoder's inputs for the first `count` pairs of a slice, x (count, DECODER_IN): the
// vectors of the larger patch and of the smaller one, their scalars, and the facts.
static NSVCD__NOINLINE void nsvcd__inputs_write(const nsvcd__inputs *in, const nsvcd__pairs *p,
                                                size_t count, float *x) {
  const nsvcd__v step = nsvcd__v_set(NSVCD__LATENT_STEP);
  float wigner[NSVCD__WIGNER][NSVCD__SLICE];
  for (size_t n = 0; n < 2; n++) {
    nsvcd__wigner(&in->turn[n], nsvcd__v_mul(in->k[n], step), wigner);
    for (size_t l = 0; l < count; l++) {
      const size_t slot = (in->keep >> l & 1) == n;
      nsvcd__rotate_latent(p->z[n][l], wigner, l, slot, x + NSVCD__DECODER_IN * l);
    }
  }
  for (size_t l = 0; l < count; l++) {
    float *facts = x + NSVCD__DECODER_IN * l + 2 * NSVCD__LATENT;
    for (size_t k = 0; k < NSVCD__DECODER_IN - 2 * NSVCD__LATENT; k++)
      facts[k] = k < NSVCD__FACTS ? in->facts[k][l] : 0;
  }
}

static NSVCD__NOINLINE void nsvcd__invariants(const nsvcd__pairs *p, size_t count, float *x) {
  nsvcd__inputs inputs;
  nsvcd__inputs_of(p, count, &inputs);
  nsvcd__inputs_write(&inputs, p, count, x);
}
#endif  // NSVCD_NO_NETWORK

// --------------------------------------------------------------------------------- network/decoder
// In: invariants of pairs (n, DECODER_IN). Out: a logit each, and the pair's least distance. Pairs
// come in batches of up to 16, and their invariants go through the layers some rows at a time.

#ifndef NSVCD_NO_NETWORK
#define NSVCD__BATCH NSVCD__LANES
// Rows of inputs at a time, and how many of them layers of floats take together. A machine without
// vectors may have no stack for more; without floats, more than one row at a time gains nothing.
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
// Most outputs of a layer in the decoders that are compiled. The tests compare them to weights.h.
#define NSVCD__WIDEST_TINY 32
#define NSVCD__WIDEST_SMALL 96
#ifndef NSVCD_NO_BASE
#define NSVCD__WIDEST NSVCD_W_WIDEST
#elif !defined(NSVCD_NO_SMALL)
#define NSVCD__WIDEST NSVCD__WIDEST_SMALL
#else
#define NSVCD__WIDEST NSVCD__WIDEST_TINY
#endif
#define NSVCD__MOST_INPUTS \
  (NSVCD__WIDEST > NSVCD__DECODER_IN ? NSVCD__WIDEST : NSVCD__DECODER_IN)

// What a decoder makes of a pair.
enum {
  NSVCD__OUT_LOGIT,
  NSVCD__OUT_DISTANCE,  // the least distance, or minus the depth, in tenths of r1 + r2
  NSVCD__DECODER_OUT
};

// A layer, y = w^T x + bias, and where its numbers begin.
typedef struct nsvcd__layer {
  size_t inputs, outputs;  // multiples of 4, and of 16
  size_t weights;          // (inputs, outputs) in nsvcd_w_decoder, and in nsvcd_w_decoder_int8
  size_t first;            // (outputs) in nsvcd_w_decoder_bias, _scale and _sum
  int relu;                // of all layers but the last
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
// Outputs o .. o + tiles * SLICE - 1 of a layer for so many rows: x, a row every `pitch` floats,
// and y (rows, WIDEST). rows * tiles sums must fit into the registers.
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

// A layer in fp32, for `count` rows, a multiple of ROW_STEP: x, a row every `pitch` floats, and y
// (count, WIDEST). The weights of the largest decoder do not fit into the first cache, so that more
// rows at a time are faster: 8 by 2 or 4 by 4 sums in 32 registers; in fewer, 4 rows by 16 outputs,
// or by 4 slices if that is less.
#define NSVCD__TILES (NSVCD__LANES / NSVCD__SLICE < 4 ? NSVCD__LANES / NSVCD__SLICE : 4)
static NSVCD__NOINLINE void nsvcd__layer_by_floats(const nsvcd__layer *layer, const float *x,
                                                   size_t pitch, size_t count, float *y) {
  const size_t outputs = layer->outputs;
  size_t p = 0;
  size_t o;
#if NSVCD__SLICE == 16
  for (; p + 8 <= count; p += 8, x += 8 * pitch, y += 8 * NSVCD__WIDEST) {
    for (o = 0; o + 32 <= outputs; o += 32) nsvcd__layer_tile(layer, o, x, pitch, y, 8, 2);
    if (o < outputs) nsvcd__layer_tile(layer, o, x, pitch, y, 8, 1);
  }
#endif
  for (; p < count; p += 4, x += 4 * pitch, y += 4 * NSVCD__WIDEST) {
#if NSVCD__SLICE == 16
    for (o = 0; o + 64 <= outputs; o += 64) nsvcd__layer_tile(layer, o, x, pitch, y, 4, 4);
    for (; o + 32 <= outputs; o += 32) nsvcd__layer_tile(layer, o, x, pitch, y, 4, 2);
    if (o < outputs) nsvcd__layer_tile(layer, o, x, pitch, y, 4, 1);
#else
    for (o = 0; o < outputs; o += NSVCD__TILES * NSVCD__SLICE)
      nsvcd__layer_tile(layer, o, x, pitch, y, 4, NSVCD__TILES);
#endif
  }
}
#endif  // NSVCD_NO_FLOAT

#ifndef NSVCD_NO_INT8
// nsvcd__layer_by_bytes is a layer in integers, for BYTE_ROWS rows, which share the weights that
// are loaded: x, a row every `pitch` floats, and y (BYTE_ROWS, WIDEST), which may be x. Inputs are
// divided by the largest, and become bytes in [1, 255] about 128: processors multiply unsigned by
// signed bytes. Weights are (inputs / 4, outputs, 4). Sums are exact in int32, and too large by 128
// times the sum of the weights.
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
#endif  // NSVCD_NO_INT8

// x (ROWS, DECODER_IN) -> out (count, DECODER_OUT), of the first `count` pairs, in fp32 or int8
// arithmetic. x must hold numbers up to a multiple of ROW_STEP rows.
static NSVCD__NOINLINE void nsvcd__decoder_run(const nsvcd__decoder *decoder, const float *x,
                                               size_t count, int int8,
                                               float (*out)[NSVCD__DECODER_OUT]) {
  float a[NSVCD__ROWS * NSVCD__WIDEST];
#ifndef NSVCD_NO_FLOAT
  float b[NSVCD__ROWS * NSVCD__WIDEST];
#else
  float *const b = a;  // layers in integers need no second array
#endif
  float *y = a;
  size_t pitch = NSVCD__DECODER_IN;
  for (size_t n = 0; n < decoder->layers; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
#ifndef NSVCD_NO_INT8
    for (size_t p = 0; p < count && int8; p += NSVCD__BYTE_ROWS)
      nsvcd__layer_by_bytes(&layer, x + pitch * p, pitch, y + NSVCD__WIDEST * p);
#endif
#ifndef NSVCD_NO_FLOAT
    const size_t rows = nsvcd__round_up(count, NSVCD__ROW_STEP);
    if (!int8) nsvcd__layer_by_floats(&layer, x, pitch, rows, y);
#endif
    x = y;
    pitch = NSVCD__WIDEST;
    y = y == a ? b : a;
  }
  for (size_t p = 0; p < count; p++) memcpy(out[p], x + pitch * p, sizeof out[p]);
}
#endif  // NSVCD_NO_NETWORK

// --------------------------------------------------------------------------------- network/opinion
// In: a task. Out: the network's opinion: candidates, ranked, and a logit for the best of them.

#ifndef NSVCD_NO_NETWORK
// Scores `count` candidates, 1 to 16, by a decoder.
static void nsvcd__decode(const nsvcd__task *task, nsvcd__candidate *const *candidates,
                          size_t count, const nsvcd__decoder *decoder) {
  for (size_t first = 0; first < count; first += NSVCD__ROWS) {
    const size_t left = count - first;
    const size_t rows = left < NSVCD__ROWS ? left : NSVCD__ROWS;
    // The layers take ROW_STEP rows at a time.
    const size_t unused = nsvcd__round_up(rows, NSVCD__ROW_STEP) - rows;
#if NSVCD__ROWS > 1
    float x[NSVCD__ROWS * NSVCD__DECODER_IN];
#else
    float *x = task->row;
#endif
    float out[NSVCD__ROWS][NSVCD__DECODER_OUT];
    for (size_t l = 0; l < rows; l += NSVCD__SLICE) {
      const size_t size = rows - l < NSVCD__SLICE ? rows - l : NSVCD__SLICE;
      nsvcd__pairs pairs;
      nsvcd__pairs_of(task->moving, task->fixed, &task->motion, candidates + first + l, size,
                      &pairs);
      nsvcd__invariants(&pairs, size, x + NSVCD__DECODER_IN * l);
    }
    memset(x + NSVCD__DECODER_IN * rows, 0, unused * NSVCD__DECODER_IN * sizeof *x);
    nsvcd__decoder_run(decoder, x, rows, task->settings.int8, out);
    for (size_t k = 0; k < rows; k++) {
      candidates[first + k]->score = out[k][NSVCD__OUT_LOGIT];
      candidates[first + k]->apart = out[k][NSVCD__OUT_DISTANCE];
    }
  }
}

// Scores candidates that have no score yet, `most` at most: roughly the deeper ones, with which a
// heap ends. Returns 0, and does nothing, if there are fewer than `least`.
static int nsvcd__score(const nsvcd__task *task, nsvcd__candidates *kept, size_t least,
                        size_t most) {
  nsvcd__candidate *batch[NSVCD__BATCH];
  size_t count = 0;
  size_t left = 0;
  for (size_t k = 0; k < kept->count; k++) left += kept->items[k].score <= NSVCD__NO_SCORE;
  if (left < least || left == 0) return 0;
  left = left < most ? left : most;
  for (size_t k = kept->count; left > 0; k--) {
    nsvcd__candidate *c = &kept->items[k - 1];
    if (c->score > NSVCD__NO_SCORE) continue;
    batch[count++] = c;
    if (count < NSVCD__BATCH && count < left) continue;
    nsvcd__decode(task, batch, count, task->settings.ranker);
    left -= count;
    count = 0;
  }
  return 1;
}

// The sum of the radii of a candidate's patches, metres.
static float nsvcd__candidate_radius(const nsvcd__task *task, const nsvcd__candidate *c) {
  const float own = task->motion.scale * nsvcd__body_r(task->moving)[c->moving];
  return task->motion.unit * (own + nsvcd__body_r(task->fixed)[c->fixed]);
}

// Answers with a candidate that this decoder has scored.
static void nsvcd__answer_with(const nsvcd__task *task, const nsvcd__candidate *c,
                               const nsvcd__decoder *decoder, nsvcd_opinion *out) {
  out->logit = c->score - task->settings.threshold;
  out->distance = 0.1f * c->apart * nsvcd__candidate_radius(task, c);
  out->time = c->t_least;
  out->patch_a = c->moving;
  out->patch_b = c->fixed;
  if (task->decisive) {
    task->decisive->candidate = *c;
    task->decisive->decoder = decoder;
  }
}

// Is a distance asked for? Then the nearest candidate decides, not the most suspicious, and nothing
// is clear before all candidates are known.
static int nsvcd__of_distance(const nsvcd__task *task) {
  return task->question->ask == NSVCD_ASK_DISTANCE;
}

// The candidate with the greatest closeness decides.
static float nsvcd__closeness(const nsvcd__task *task, const nsvcd__candidate *c) {
  if (!nsvcd__of_distance(task)) return c->score;
  return -c->apart * nsvcd__candidate_radius(task, c);
}

// Is a candidate clearly no collision, by the tiny decoder?
static int nsvcd__is_harmless(const nsvcd__candidate *c, float threshold) {
  return c->score < (threshold < 0 ? threshold : 0) - NSVCD__CLEAR_LOGIT;
}

// Is the most suspicious of the candidates scored so far clearly a collision, by this logit, or, if
// they are all, clearly none? Then that is the answer, and no other decoder is needed.
static int nsvcd__is_clear(const nsvcd__task *task, const nsvcd__candidates *kept, int all,
                           float logit, nsvcd_opinion *out) {
  const float threshold = task->settings.threshold;
  if (nsvcd__of_distance(task)) return 0;
  const nsvcd__candidate *most = &kept->items[0];
  for (size_t k = 1; k < kept->count; k++)
    most = kept->items[k].score > most->score ? &kept->items[k] : most;
  const int yes = most->score > logit + (threshold > 0 ? threshold : 0);
  const int no = all && nsvcd__is_harmless(most, threshold);
  if (yes || no) nsvcd__answer_with(task, most, task->settings.ranker, out);
  return yes || no;
}

// The chosen decoder judges the K most suspicious of the scored candidates, but for harmless ones,
// a portion at a time, until one is clearly positive.
static void nsvcd__judge(const nsvcd__task *task, nsvcd__candidates *kept,
                         nsvcd_opinion *out) {
  const nsvcd__settings *settings = &task->settings;
  nsvcd__candidate *items = kept->items;
  size_t count = kept->count < settings->pairs ? kept->count : settings->pairs;
  // sorts the highest scores to the front
  for (size_t k = 0; k < count; k++) {
    size_t best = k;
    for (size_t i = k + 1; i < kept->count; i++) {
      const float here = nsvcd__closeness(task, &items[i]);
      const float d = here - nsvcd__closeness(task, &items[best]);
      if (d > 0 || (d >= 0 && nsvcd__is_shallower(&items[best], &items[i]))) best = i;
    }
    const nsvcd__candidate first = items[best];
    items[best] = items[k];
    items[k] = first;
  }
  const int all = nsvcd__of_distance(task);
  float most = -HUGE_VALF;
  while (!all && count > 1 && nsvcd__is_harmless(&items[count - 1], settings->threshold))
    count--;
  for (size_t first = 0; first < count; first += NSVCD__PORTION) {
    if (!all && !(out->logit < NSVCD__CLEAR_LOGIT)) break;
    nsvcd__candidate *portion[NSVCD__PORTION] = {NULL};
    const size_t left = count - first;
    const size_t size = left < NSVCD__PORTION ? left : NSVCD__PORTION;
    for (size_t k = 0; k < size; k++) portion[k] = &items[first + k];
    if (settings->decoder != settings->ranker)
      nsvcd__decode(task, portion, size, settings->decoder);
    for (size_t k = 0; k < size; k++) {
      const float closeness = nsvcd__closeness(task, portion[k]);
      if (!(closeness > most)) continue;
      most = closeness;
      nsvcd__answer_with(task, portion[k], settings->decoder, out);
    }
  }
}

// Does a motion that has been cut clearly collide where the hint says?
static NSVCD__NOINLINE int nsvcd__collides_again(nsvcd__query *query, const nsvcd__hint *hint,
                                                 nsvcd_opinion *out) {
  const nsvcd__task *task = &query->task;
  const nsvcd__settings *settings = &task->settings;
  nsvcd__candidates kept;
  nsvcd__candidates_start(&kept, query->kept, NSVCD__PORTION);
  nsvcd__plane_cache_begin(&query->broad_phase, settings->inflate);
  nsvcd__search_patch(&query->broad_phase, task->moving, hint->moving / NSVCD__GROUP,
                      task->fixed, hint->fixed, &kept);
  if (!nsvcd__score(task, &kept, 1, kept.count)) return 0;
  out->candidates = kept.total;
  out->limited = kept.total > settings->pairs;
  if (nsvcd__is_clear(task, &kept, 0, NSVCD__CLEAR_LOGIT, out)) return 1;
  if (settings->decoder == settings->ranker) return 0;
  nsvcd__judge(task, &kept, out);
  return out->logit >= NSVCD__CLEAR_LOGIT;
}

// Searches a motion that has been cut, and judges pairs as they are found, until one is clear or
// all are known.
static NSVCD__NOINLINE void nsvcd__search_and_judge(nsvcd__query *query, nsvcd_opinion *out) {
  const nsvcd__task *task = &query->task;
  const size_t shortlist = task->settings.shortlist;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__candidates kept;
  size_t worth = shortlist < NSVCD__FIRST_BATCH ? shortlist : NSVCD__FIRST_BATCH;
  size_t left = NSVCD__RANKED_TWICE * shortlist;
  int clear = 0;
  nsvcd__plane_cache_begin(search, task->settings.inflate);
  int more = nsvcd__search_begin(task->moving, task->fixed, ~(uint64_t)0, search);
  if (more && !nsvcd__of_distance(task)) {
    // A deep collision shows in the first pair of groups. Planes, which would take most of the
    // time, are not asked there.
    nsvcd__candidates_start(&kept, query->kept, worth);
    const int balls_only = search->cache->balls_only;
    search->cache->balls_only = 1;
    nsvcd__search_pair(search, &kept);
    search->cache->balls_only = balls_only;
    if (nsvcd__score(task, &kept, worth, worth)) {
      left -= worth;
      clear = nsvcd__is_clear(task, &kept, 0, NSVCD__FIRST_CLEAR, out);
    }
  }
  if (!clear) nsvcd__candidates_start(&kept, query->kept, shortlist);
  while (more && !clear) {
    more = nsvcd__search_step(search, &kept);
    // A deep collision shows early. What is scored now is not scored again, so this costs little.
    if (!more || left < worth || !nsvcd__score(task, &kept, worth, worth)) continue;
    left -= worth;
    clear = nsvcd__is_clear(task, &kept, 0, NSVCD__CLEAR_LOGIT, out);
    if (worth == NSVCD__FIRST_BATCH) worth = NSVCD__BATCH;
  }

  out->candidates = kept.total;
  out->limited = kept.total > task->settings.pairs;
  if (clear || kept.count == 0) return;
  nsvcd__score(task, &kept, 1, kept.count);
  if (!nsvcd__is_clear(task, &kept, 1, NSVCD__CLEAR_LOGIT, out))
    nsvcd__judge(task, &kept, out);
}

// Is a part of one body inside the other at the start?
static NSVCD__NOINLINE int nsvcd__seems_contained_at_start(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *m = &task->motion;
  nsvcd__segments *first = query->broad_phase.blocks;
  const nsvcd__mat3 scaled = nsvcd__mat3_lane(first->rotation, 0);
  const nsvcd__transform pose = {nsvcd__mat3_mix(m->per_scale, &scaled, 0, &scaled),
                                 nsvcd__lane_of(first->position, 0)};
  return nsvcd__is_contained(task->moving, task->fixed, m->scale, &pose);
}

// An opinion that needs no decoder.
static void nsvcd__certain_opinion(float logit, nsvcd_opinion *out) {
  memset(out, 0, sizeof *out);
  out->asked = 1;
  out->logit = logit;
  out->distance = HUGE_VALF;
}

// Asks the network about a motion that has been prepared. hint: NULL, or that of a batch. Returns
// whether one body seems to be inside the other at the start.
static int nsvcd__ask_network(nsvcd__query *query, nsvcd__hint *hint, nsvcd_opinion *out) {
  nsvcd__task *task = &query->task;
  const int hinted = hint && hint->known && !nsvcd__of_distance(task);
  // has been checked
  (void)nsvcd__settings_of(&task->question->network, task->moving->patches,
                           task->fixed->patches, &task->settings);
  if (nsvcd__of_distance(task) && task->question->network.inflate <= 0)
    task->settings.inflate = NSVCD__INFLATE_DISTANCE;
  nsvcd__certain_opinion(-NSVCD_LOGIT_CERTAIN, out);
  query->broad_phase.balls_met = 0;
  if (nsvcd__motion_gap(&task->motion) > task->lengths) return 0;
  nsvcd__cut_motion(&task->motion, task->lengths, &query->broad_phase);
  if (!hinted || !nsvcd__collides_again(query, hint, out)) {
    nsvcd__certain_opinion(-NSVCD_LOGIT_CERTAIN, out);
    if (hinted) hint->known = ++hint->misled < NSVCD__MISLEADS;
    nsvcd__search_and_judge(query, out);
  }
  if (hint && out->logit >= NSVCD__CLEAR_LOGIT) {
    const nsvcd__hint here = {1, 0, out->patch_a, out->patch_b};
    *hint = here;
  }

  // A body inside another need not touch anything.
  if (out->logit > 0 || !nsvcd__seems_contained_at_start(query)) return 0;
  const size_t candidates = out->candidates;
  nsvcd__certain_opinion(NSVCD_LOGIT_CERTAIN, out);
  out->candidates = candidates;
  return 1;
}

#endif  // NSVCD_NO_NETWORK

// ------------------------------------------------------------------------------------ network/tape
// In: the candidate that decided an answer. Out: its tape: what its derivative takes from vectors.

#ifndef NSVCD_NO_GRADIENT
// Lane 0 of each of so many slices: out (count).
static void nsvcd__first_lanes(const void *slices, size_t count, void *out) {
  for (size_t k = 0; k < count; k++) {
    nsvcd__v slice;
    float lanes[NSVCD__SLICE];
    memcpy(&slice, (const char *)slices + k * sizeof slice, sizeof slice);
    nsvcd__v_store(lanes, slice);
    memcpy((char *)out + k * sizeof *lanes, lanes, sizeof *lanes);
  }
}

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

// The derivative of a decoder's output by its inputs: x, by_x (DECODER_IN). A ReLU's derivative at
// 0 is 0.
static NSVCD__NOINLINE void nsvcd__decoder_gradient(const nsvcd__decoder *decoder,
                                                    size_t output, const float *x,
                                                    float *by_x) {
  // the outputs of all layers but the last
  float values[5][NSVCD__WIDEST];
  float by[NSVCD__MOST_INPUTS] = {0};
  by[output] = 1;
  const size_t last = decoder->layers - 1;
  for (size_t n = 0; n < last; n++) {
    const nsvcd__layer layer = nsvcd__layer_of(decoder, n);
    const float *from = n > 0 ? values[n - 1] : x;
    float *y = values[n];
    memcpy(y, nsvcd_w_decoder_bias + layer.first, layer.outputs * sizeof *y);
    for (size_t i = 0; i < layer.inputs; i++) {
      // about half of the inputs are 0
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

// Writes a tape whose times are known.
static void nsvcd__record(const nsvcd__task *task, nsvcd__tape *tape) {
  const nsvcd__motion *m = &task->motion;
  nsvcd__candidate *c = &task->decisive->candidate;
  nsvcd__pairs pairs;
  nsvcd__views views;
  nsvcd__v3 axes[NSVCD__GAPS];
  nsvcd__v gaps[NSVCD__GAPS];
  int8_t extremes[2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE];
  nsvcd__pairs_of(task->moving, task->fixed, m, &c, 1, &pairs);
  nsvcd__views_of(&pairs, &views);
  nsvcd__first_lanes(&pairs, sizeof tape->pair / sizeof(float), &tape->pair);
  nsvcd__first_lanes(&views, sizeof tape->view / sizeof(float), &tape->view);
  nsvcd__gap_axes_of(&pairs, &views, axes);
  nsvcd__first_lanes(axes, 3 * NSVCD__GAPS, tape->axes);
  nsvcd__extremes_collect(&pairs, 1, extremes);
  for (size_t k = 0; k < NSVCD__MOMENTS; k++) {
    const nsvcd__v tau = nsvcd__v_scale(views.time, (float)k - 1);
    nsvcd__gaps_at(&pairs, axes, extremes, tau, gaps);
    nsvcd__first_lanes(gaps, NSVCD__GAPS, tape->gaps[k]);
  }
  for (size_t n = 0; n < 2; n++) tape->extremes[n] = pairs.extremes[n][0];

  const int of_logit = !nsvcd__of_distance(task);
  const size_t output = of_logit ? NSVCD__OUT_LOGIT : NSVCD__OUT_DISTANCE;
  const float unit = of_logit ? 1 : 0.1f * nsvcd__candidate_radius(task, c);
  nsvcd__invariants(&pairs, 1, tape->x);
  nsvcd__decoder_gradient(task->decisive->decoder, output, tape->x, tape->by_x);
  for (size_t k = 0; k < NSVCD__DECODER_IN; k++) tape->by_x[k] *= unit;

  const nsvcd__f3 own = nsvcd__centre_of(nsvcd__body_patches(task->moving), c->moving);
  const nsvcd__v3 centre = nsvcd__v3_set(nsvcd__f3_scale(own, m->scale));
  nsvcd__f3 from_pivot = own;
  if (m->moving.pivot) from_pivot = nsvcd__f3_sub(own, nsvcd__f3_load(m->moving.pivot));
  const nsvcd__v3 arm = nsvcd__v3_set(nsvcd__f3_scale(from_pivot, m->scale));
  for (size_t first = 0; first < NSVCD__INSTANTS; first += NSVCD__SLICE) {
    const size_t left = NSVCD__INSTANTS - first;
    const size_t count = left < NSVCD__SLICE ? left : NSVCD__SLICE;
    const nsvcd__v_pose pose = nsvcd__v_poses_at(m, tape->at.t + first, count);
    const nsvcd__vmat3 rotation = nsvcd__vmat3_of(pose.rotation);
    nsvcd__v3_store(tape->at.arm, first, nsvcd__vmat3_apply(rotation, arm));
    const nsvcd__v3 to_centre = nsvcd__vmat3_apply(rotation, centre);
    nsvcd__v3_store(tape->at.position, first, nsvcd__v3_add(to_centre, pose.position));
  }
}
#endif  // NSVCD_NO_GRADIENT

#ifndef NSVCD__ISA
// =============================================== entry: the kernels of each set, and the best ones

// --------------------------------------------------------------------------------- entry/processor
// In: a processor. Out: the kernels for the widest vectors that it has.
//
// THE WAIST. A *kernel* is a function that works on vectors and is called from above. There are
// seven: self_test_lanes, separate, is_contained_at_start, bound_distance, seek_positions,
// ask_network and record. NSVCD__KERNEL(isa, separate)(...) calls one of them.
//
// If the compiler's flags allow SSE2 only, the default on x86-64, the rooms that use vectors are
// compiled three times: with SSE2 above, and here with AVX2 and with AVX-512, under other private
// names: nsvcd__separate becomes nsvcd__separate_avx2. For that the header includes itself. At each
// call the processor decides which of them answers. NSVCD_NO_DISPATCH leaves SSE2 only.

#if NSVCD__SLICE == 4 && !defined(NSVCD_NO_DISPATCH) && !defined(NSVCD__NARROW) && \
    !defined(NSVCD__FROM_ROOMS)
#if defined(__clang__) && defined(_MSC_VER)
// clang-cl's <immintrin.h> has only what the flags allow: /arch:AVX2
#elif defined(__x86_64__) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 8))
#define NSVCD__DISPATCH
#elif defined(_M_X64) && !defined(_M_ARM64EC)
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
#define NSVCD__ALONG_BOTH NSVCD__NUMBER_AT(ALONG_BOTH)
#define NSVCD__ALONG_LINE NSVCD__NUMBER_AT(ALONG_LINE)
#define NSVCD__ALONG_MOVING NSVCD__NUMBER_AT(ALONG_MOVING)
#define NSVCD__ALONG_RESTING NSVCD__NUMBER_AT(ALONG_RESTING)
#define NSVCD__DECODER_OUT NSVCD__NUMBER_AT(DECODER_OUT)
#define NSVCD__DIRECTIONS NSVCD__NUMBER_AT(DIRECTIONS)
#define NSVCD__OUT_DISTANCE NSVCD__NUMBER_AT(OUT_DISTANCE)
#define NSVCD__OUT_LOGIT NSVCD__NUMBER_AT(OUT_LOGIT)
#define nsvcd__across_edges NSVCD__AT(across_edges)
#define nsvcd__add_dipoles NSVCD__AT(add_dipoles)
#define nsvcd__add_patch_pairs NSVCD__AT(add_patch_pairs)
#define nsvcd__aim_plane NSVCD__AT(aim_plane)
#define nsvcd__all_segments NSVCD__AT(all_segments)
#define nsvcd__answer_with NSVCD__AT(answer_with)
#define nsvcd__arc_at NSVCD__AT(arc_at)
#define nsvcd__arc_limit NSVCD__AT(arc_limit)
#define nsvcd__arc_of NSVCD__AT(arc_of)
#define nsvcd__arc_pose NSVCD__AT(arc_pose)
#define nsvcd__are_opposite NSVCD__AT(are_opposite)
#define nsvcd__arm NSVCD__AT(arm)
#define nsvcd__arm_of NSVCD__AT(arm_of)
#define nsvcd__ask_network NSVCD__AT(ask_network)
#define nsvcd__beam NSVCD__AT(beam)
#define nsvcd__bend_of NSVCD__AT(bend_of)
#define nsvcd__beyond NSVCD__AT(beyond)
#define nsvcd__block_arm NSVCD__AT(block_arm)
#define nsvcd__block_bounds NSVCD__AT(block_bounds)
#define nsvcd__block_lanes NSVCD__AT(block_lanes)
#define nsvcd__block_load NSVCD__AT(block_load)
#define nsvcd__block_pose NSVCD__AT(block_pose)
#define nsvcd__bound_distance NSVCD__AT(bound_distance)
#define nsvcd__bound_of NSVCD__AT(bound_of)
#define nsvcd__boxes_of_groups NSVCD__AT(boxes_of_groups)
#define nsvcd__candidate_radius NSVCD__AT(candidate_radius)
#define nsvcd__candidates_add NSVCD__AT(candidates_add)
#define nsvcd__candidates_start NSVCD__AT(candidates_start)
#define nsvcd__certain_opinion NSVCD__AT(certain_opinion)
#define nsvcd__chords_in_all NSVCD__AT(chords_in_all)
#define nsvcd__chords_in_segment NSVCD__AT(chords_in_segment)
#define nsvcd__chords_of_group NSVCD__AT(chords_of_group)
#define nsvcd__chords_of_tile NSVCD__AT(chords_of_tile)
#define nsvcd__chords_start NSVCD__AT(chords_start)
#define nsvcd__chords_store NSVCD__AT(chords_store)
#define nsvcd__chords_travel NSVCD__AT(chords_travel)
#define nsvcd__clip_segment NSVCD__AT(clip_segment)
#define nsvcd__closeness NSVCD__AT(closeness)
#define nsvcd__collect_contact NSVCD__AT(collect_contact)
#define nsvcd__collect_contacts NSVCD__AT(collect_contacts)
#define nsvcd__collect_supports NSVCD__AT(collect_supports)
#define nsvcd__collects_on NSVCD__AT(collects_on)
#define nsvcd__collides_again NSVCD__AT(collides_again)
#define nsvcd__comes_near NSVCD__AT(comes_near)
#define nsvcd__comes_within NSVCD__AT(comes_within)
#define nsvcd__contact_at NSVCD__AT(contact_at)
#define nsvcd__contains_any NSVCD__AT(contains_any)
#define nsvcd__contains_seeds NSVCD__AT(contains_seeds)
#define nsvcd__corner_passes NSVCD__AT(corner_passes)
#define nsvcd__cross_all NSVCD__AT(cross_all)
#define nsvcd__crossings NSVCD__AT(crossings)
#define nsvcd__cut_arc NSVCD__AT(cut_arc)
#define nsvcd__cut_block NSVCD__AT(cut_block)
#define nsvcd__cut_deviations NSVCD__AT(cut_deviations)
#define nsvcd__cut_double_arc NSVCD__AT(cut_double_arc)
#define nsvcd__cut_ends NSVCD__AT(cut_ends)
#define nsvcd__cut_keyframe NSVCD__AT(cut_keyframe)
#define nsvcd__cut_motion NSVCD__AT(cut_motion)
#define nsvcd__cut_poses NSVCD__AT(cut_poses)
#define nsvcd__cut_segments NSVCD__AT(cut_segments)
#define nsvcd__decode NSVCD__AT(decode)
#define nsvcd__decoder_gradient NSVCD__AT(decoder_gradient)
#define nsvcd__decoder_run NSVCD__AT(decoder_run)
#define nsvcd__depth_along NSVCD__AT(depth_along)
#define nsvcd__deviation_of NSVCD__AT(deviation_of)
#define nsvcd__dot_tile NSVCD__AT(dot_tile)
#define nsvcd__dtransform_at NSVCD__AT(dtransform_at)
#define nsvcd__edges_pass NSVCD__AT(edges_pass)
#define nsvcd__enclosure NSVCD__AT(enclosure)
#define nsvcd__exists NSVCD__AT(exists)
#define nsvcd__exit_depth NSVCD__AT(exit_depth)
#define nsvcd__exit_is_blocked NSVCD__AT(exit_is_blocked)
#define nsvcd__extremes_along NSVCD__AT(extremes_along)
#define nsvcd__extremes_collect NSVCD__AT(extremes_collect)
#define nsvcd__f3_towards NSVCD__AT(f3_towards)
#define nsvcd__face_direction NSVCD__AT(face_direction)
#define nsvcd__facing NSVCD__AT(facing)
#define nsvcd__facing_of NSVCD__AT(facing_of)
#define nsvcd__find_witness NSVCD__AT(find_witness)
#define nsvcd__find_witness_in NSVCD__AT(find_witness_in)
#define nsvcd__first_lanes NSVCD__AT(first_lanes)
#define nsvcd__fixed_closed NSVCD__AT(fixed_closed)
#define nsvcd__gap_after NSVCD__AT(gap_after)
#define nsvcd__gap_axes_of NSVCD__AT(gap_axes_of)
#define nsvcd__gap_fact NSVCD__AT(gap_fact)
#define nsvcd__gap_facts NSVCD__AT(gap_facts)
#define nsvcd__gaps_at NSVCD__AT(gaps_at)
#define nsvcd__greatest_of NSVCD__AT(greatest_of)
#define nsvcd__group_against_group NSVCD__AT(group_against_group)
#define nsvcd__group_against_members NSVCD__AT(group_against_members)
#define nsvcd__group_extent NSVCD__AT(group_extent)
#define nsvcd__held_again NSVCD__AT(held_again)
#define nsvcd__hull_of NSVCD__AT(hull_of)
#define nsvcd__hulls_are_apart NSVCD__AT(hulls_are_apart)
#define nsvcd__inputs NSVCD__AT(inputs)
#define nsvcd__inputs_of NSVCD__AT(inputs_of)
#define nsvcd__inputs_without_gaps NSVCD__AT(inputs_without_gaps)
#define nsvcd__inputs_write NSVCD__AT(inputs_write)
#define nsvcd__interval_cuts NSVCD__AT(interval_cuts)
#define nsvcd__interval_of_arc NSVCD__AT(interval_of_arc)
#define nsvcd__intervals NSVCD__AT(intervals)
#define nsvcd__intervals_close NSVCD__AT(intervals_close)
#define nsvcd__invariants NSVCD__AT(invariants)
#define nsvcd__inverse_dtransform NSVCD__AT(inverse_dtransform)
#define nsvcd__is_approached NSVCD__AT(is_approached)
#define nsvcd__is_before NSVCD__AT(is_before)
#define nsvcd__is_clear NSVCD__AT(is_clear)
#define nsvcd__is_contained NSVCD__AT(is_contained)
#define nsvcd__is_contained_at_start NSVCD__AT(is_contained_at_start)
#define nsvcd__is_contained_in NSVCD__AT(is_contained_in)
#define nsvcd__is_deep NSVCD__AT(is_deep)
#define nsvcd__is_enclosed NSVCD__AT(is_enclosed)
#define nsvcd__is_harmless NSVCD__AT(is_harmless)
#define nsvcd__is_left NSVCD__AT(is_left)
#define nsvcd__is_new NSVCD__AT(is_new)
#define nsvcd__is_on_beam NSVCD__AT(is_on_beam)
#define nsvcd__is_separated NSVCD__AT(is_separated)
#define nsvcd__is_shallower NSVCD__AT(is_shallower)
#define nsvcd__is_straight NSVCD__AT(is_straight)
#define nsvcd__judge NSVCD__AT(judge)
#define nsvcd__keep_support NSVCD__AT(keep_support)
#define nsvcd__keep_unresolved NSVCD__AT(keep_unresolved)
#define nsvcd__keyframes_load NSVCD__AT(keyframes_load)
#define nsvcd__keyframes_read NSVCD__AT(keyframes_read)
#define nsvcd__keyframes_store NSVCD__AT(keyframes_store)
#define nsvcd__know_moving NSVCD__AT(know_moving)
#define nsvcd__know_resting NSVCD__AT(know_resting)
#define nsvcd__lanes_left_by_known NSVCD__AT(lanes_left_by_known)
#define nsvcd__lanes_left_by_last NSVCD__AT(lanes_left_by_last)
#define nsvcd__lanes_left_by_own NSVCD__AT(lanes_left_by_own)
#define nsvcd__lanes_near NSVCD__AT(lanes_near)
#define nsvcd__lanes_on_ray NSVCD__AT(lanes_on_ray)
#define nsvcd__lanes_outside NSVCD__AT(lanes_outside)
#define nsvcd__layer NSVCD__AT(layer)
#define nsvcd__layer_by_bytes NSVCD__AT(layer_by_bytes)
#define nsvcd__layer_by_floats NSVCD__AT(layer_by_floats)
#define nsvcd__layer_of NSVCD__AT(layer_of)
#define nsvcd__layer_tile NSVCD__AT(layer_tile)
#define nsvcd__least_lane NSVCD__AT(least_lane)
#define nsvcd__least_of NSVCD__AT(least_of)
#define nsvcd__left_by_normal NSVCD__AT(left_by_normal)
#define nsvcd__matters NSVCD__AT(matters)
#define nsvcd__may_be_close NSVCD__AT(may_be_close)
#define nsvcd__meet NSVCD__AT(meet)
#define nsvcd__meet_in NSVCD__AT(meet_in)
#define nsvcd__meet_members NSVCD__AT(meet_members)
#define nsvcd__meets_sphere NSVCD__AT(meets_sphere)
#define nsvcd__members_left NSVCD__AT(members_left)
#define nsvcd__members_meet NSVCD__AT(members_meet)
#define nsvcd__members_of NSVCD__AT(members_of)
#define nsvcd__moving_block_load NSVCD__AT(moving_block_load)
#define nsvcd__moving_closed NSVCD__AT(moving_closed)
#define nsvcd__moving_range NSVCD__AT(moving_range)
#define nsvcd__nearest2 NSVCD__AT(nearest2)
#define nsvcd__nearest_at NSVCD__AT(nearest_at)
#define nsvcd__nearest_groups NSVCD__AT(nearest_groups)
#define nsvcd__nearest_tick NSVCD__AT(nearest_tick)
#define nsvcd__next_probe NSVCD__AT(next_probe)
#define nsvcd__normal_to_try NSVCD__AT(normal_to_try)
#define nsvcd__normals_separate NSVCD__AT(normals_separate)
#define nsvcd__note_depth NSVCD__AT(note_depth)
#define nsvcd__of_distance NSVCD__AT(of_distance)
#define nsvcd__off_chord_along NSVCD__AT(off_chord_along)
#define nsvcd__off_edge NSVCD__AT(off_edge)
#define nsvcd__own_axis NSVCD__AT(own_axis)
#define nsvcd__pair_arm NSVCD__AT(pair_arm)
#define nsvcd__pair_nearest NSVCD__AT(pair_nearest)
#define nsvcd__pair_of NSVCD__AT(pair_of)
#define nsvcd__pair_passes NSVCD__AT(pair_passes)
#define nsvcd__pairs NSVCD__AT(pairs)
#define nsvcd__pairs_in_passing NSVCD__AT(pairs_in_passing)
#define nsvcd__pairs_of NSVCD__AT(pairs_of)
#define nsvcd__passing NSVCD__AT(passing)
#define nsvcd__patch_arm NSVCD__AT(patch_arm)
#define nsvcd__patch_near NSVCD__AT(patch_near)
#define nsvcd__patches_apart NSVCD__AT(patches_apart)
#define nsvcd__plane_cache_begin NSVCD__AT(plane_cache_begin)
#define nsvcd__plane_separates NSVCD__AT(plane_separates)
#define nsvcd__planes_known NSVCD__AT(planes_known)
#define nsvcd__pose_members NSVCD__AT(pose_members)
#define nsvcd__pose_triangle NSVCD__AT(pose_triangle)
#define nsvcd__probes NSVCD__AT(probes)
#define nsvcd__probes_measure NSVCD__AT(probes_measure)
#define nsvcd__prove_segments NSVCD__AT(prove_segments)
#define nsvcd__prove_tiles NSVCD__AT(prove_tiles)
#define nsvcd__ranges_store NSVCD__AT(ranges_store)
#define nsvcd__ray NSVCD__AT(ray)
#define nsvcd__ray_crosses NSVCD__AT(ray_crosses)
#define nsvcd__record NSVCD__AT(record)
#define nsvcd__resolve_pair NSVCD__AT(resolve_pair)
#define nsvcd__resolve_patch_pair NSVCD__AT(resolve_patch_pair)
#define nsvcd__resolve_patch_pairs NSVCD__AT(resolve_patch_pairs)
#define nsvcd__resolve_row NSVCD__AT(resolve_row)
#define nsvcd__resolve_short_interval NSVCD__AT(resolve_short_interval)
#define nsvcd__resolve_straight NSVCD__AT(resolve_straight)
#define nsvcd__resolve_too_near NSVCD__AT(resolve_too_near)
#define nsvcd__resolve_triangles NSVCD__AT(resolve_triangles)
#define nsvcd__resting NSVCD__AT(resting)
#define nsvcd__resting_of NSVCD__AT(resting_of)
#define nsvcd__rotate_degree NSVCD__AT(rotate_degree)
#define nsvcd__rotate_latent NSVCD__AT(rotate_latent)
#define nsvcd__row_left NSVCD__AT(row_left)
#define nsvcd__score NSVCD__AT(score)
#define nsvcd__search_and_judge NSVCD__AT(search_and_judge)
#define nsvcd__search_begin NSVCD__AT(search_begin)
#define nsvcd__search_group NSVCD__AT(search_group)
#define nsvcd__search_moving_tile NSVCD__AT(search_moving_tile)
#define nsvcd__search_next_tile NSVCD__AT(search_next_tile)
#define nsvcd__search_pair NSVCD__AT(search_pair)
#define nsvcd__search_patch NSVCD__AT(search_patch)
#define nsvcd__search_step NSVCD__AT(search_step)
#define nsvcd__search_tile NSVCD__AT(search_tile)
#define nsvcd__seed_is_near NSVCD__AT(seed_is_near)
#define nsvcd__seek_in_patch_pair NSVCD__AT(seek_in_patch_pair)
#define nsvcd__seek_positions NSVCD__AT(seek_positions)
#define nsvcd__seems_contained_at_start NSVCD__AT(seems_contained_at_start)
#define nsvcd__segment_deviation NSVCD__AT(segment_deviation)
#define nsvcd__segment_interval NSVCD__AT(segment_interval)
#define nsvcd__segments_in NSVCD__AT(segments_in)
#define nsvcd__segments_left NSVCD__AT(segments_left)
#define nsvcd__segments_that_matter NSVCD__AT(segments_that_matter)
#define nsvcd__self_test_lanes NSVCD__AT(self_test_lanes)
#define nsvcd__separate NSVCD__AT(separate)
#define nsvcd__separate_groups NSVCD__AT(separate_groups)
#define nsvcd__separated_along NSVCD__AT(separated_along)
#define nsvcd__sift_patch_pairs NSVCD__AT(sift_patch_pairs)
#define nsvcd__slabs_meet NSVCD__AT(slabs_meet)
#define nsvcd__slerp_in NSVCD__AT(slerp_in)
#define nsvcd__slice_against_patch NSVCD__AT(slice_against_patch)
#define nsvcd__sort_patch_pairs NSVCD__AT(sort_patch_pairs)
#define nsvcd__spheres_at_box NSVCD__AT(spheres_at_box)
#define nsvcd__sticks_out NSVCD__AT(sticks_out)
#define nsvcd__support NSVCD__AT(support)
#define nsvcd__support_along NSVCD__AT(support_along)
#define nsvcd__surface_is_near NSVCD__AT(surface_is_near)
#define nsvcd__take_contact NSVCD__AT(take_contact)
#define nsvcd__take_nearest NSVCD__AT(take_nearest)
#define nsvcd__take_patch_pairs NSVCD__AT(take_patch_pairs)
#define nsvcd__tile_fill NSVCD__AT(tile_fill)
#define nsvcd__tile_fill_all NSVCD__AT(tile_fill_all)
#define nsvcd__time_in_segment NSVCD__AT(time_in_segment)
#define nsvcd__track_poses_at NSVCD__AT(track_poses_at)
#define nsvcd__transform_of NSVCD__AT(transform_of)
#define nsvcd__triangle_pair NSVCD__AT(triangle_pair)
#define nsvcd__turned_back NSVCD__AT(turned_back)
#define nsvcd__twist_of NSVCD__AT(twist_of)
#define nsvcd__undoes NSVCD__AT(undoes)
#define nsvcd__undone_by NSVCD__AT(undone_by)
#define nsvcd__v NSVCD__AT(v)
#define nsvcd__v3 NSVCD__AT(v3)
#define nsvcd__v3_add NSVCD__AT(v3_add)
#define nsvcd__v3_centres NSVCD__AT(v3_centres)
#define nsvcd__v3_cross NSVCD__AT(v3_cross)
#define nsvcd__v3_dot NSVCD__AT(v3_dot)
#define nsvcd__v3_dot_add NSVCD__AT(v3_dot_add)
#define nsvcd__v3_fma NSVCD__AT(v3_fma)
#define nsvcd__v3_get NSVCD__AT(v3_get)
#define nsvcd__v3_load NSVCD__AT(v3_load)
#define nsvcd__v3_load_int8 NSVCD__AT(v3_load_int8)
#define nsvcd__v3_max NSVCD__AT(v3_max)
#define nsvcd__v3_min NSVCD__AT(v3_min)
#define nsvcd__v3_negate NSVCD__AT(v3_negate)
#define nsvcd__v3_norm NSVCD__AT(v3_norm)
#define nsvcd__v3_of NSVCD__AT(v3_of)
#define nsvcd__v3_pick NSVCD__AT(v3_pick)
#define nsvcd__v3_put NSVCD__AT(v3_put)
#define nsvcd__v3_rows NSVCD__AT(v3_rows)
#define nsvcd__v3_scale NSVCD__AT(v3_scale)
#define nsvcd__v3_set NSVCD__AT(v3_set)
#define nsvcd__v3_store NSVCD__AT(v3_store)
#define nsvcd__v3_sub NSVCD__AT(v3_sub)
#define nsvcd__v3_transform NSVCD__AT(v3_transform)
#define nsvcd__v3_unit NSVCD__AT(v3_unit)
#define nsvcd__v_abs NSVCD__AT(v_abs)
#define nsvcd__v_across NSVCD__AT(v_across)
#define nsvcd__v_add_to NSVCD__AT(v_add_to)
#define nsvcd__v_approach NSVCD__AT(v_approach)
#define nsvcd__v_arc NSVCD__AT(v_arc)
#define nsvcd__v_bend NSVCD__AT(v_bend)
#define nsvcd__v_bits NSVCD__AT(v_bits)
#define nsvcd__v_clamp NSVCD__AT(v_clamp)
#define nsvcd__v_degree2 NSVCD__AT(v_degree2)
#define nsvcd__v_deviation NSVCD__AT(v_deviation)
#define nsvcd__v_half_rotation NSVCD__AT(v_half_rotation)
#define nsvcd__v_interval NSVCD__AT(v_interval)
#define nsvcd__v_interval_load NSVCD__AT(v_interval_load)
#define nsvcd__v_interval_set NSVCD__AT(v_interval_set)
#define nsvcd__v_keep NSVCD__AT(v_keep)
#define nsvcd__v_least NSVCD__AT(v_least)
#define nsvcd__v_load_int16 NSVCD__AT(v_load_int16)
#define nsvcd__v_load_int8 NSVCD__AT(v_load_int8)
#define nsvcd__v_max NSVCD__AT(v_max)
#define nsvcd__v_min NSVCD__AT(v_min)
#define nsvcd__v_negate NSVCD__AT(v_negate)
#define nsvcd__v_off NSVCD__AT(v_off)
#define nsvcd__v_pick NSVCD__AT(v_pick)
#define nsvcd__v_plus NSVCD__AT(v_plus)
#define nsvcd__v_pose NSVCD__AT(v_pose)
#define nsvcd__v_poses NSVCD__AT(v_poses)
#define nsvcd__v_poses_at NSVCD__AT(v_poses_at)
#define nsvcd__v_range NSVCD__AT(v_range)
#define nsvcd__v_scale NSVCD__AT(v_scale)
#define nsvcd__v_scaled NSVCD__AT(v_scaled)
#define nsvcd__v_seen NSVCD__AT(v_seen)
#define nsvcd__v_separate NSVCD__AT(v_separate)
#define nsvcd__v_separate_by_fixed NSVCD__AT(v_separate_by_fixed)
#define nsvcd__v_separate_by_moving NSVCD__AT(v_separate_by_moving)
#define nsvcd__v_shorter_turn NSVCD__AT(v_shorter_turn)
#define nsvcd__v_sign NSVCD__AT(v_sign)
#define nsvcd__v_signed_square NSVCD__AT(v_signed_square)
#define nsvcd__v_slab NSVCD__AT(v_slab)
#define nsvcd__v_slab_along NSVCD__AT(v_slab_along)
#define nsvcd__v_slab_load NSVCD__AT(v_slab_load)
#define nsvcd__v_slab_range NSVCD__AT(v_slab_range)
#define nsvcd__v_slab_set NSVCD__AT(v_slab_set)
#define nsvcd__v_turn NSVCD__AT(v_turn)
#define nsvcd__v_unit_or NSVCD__AT(v_unit_or)
#define nsvcd__vertex_distance NSVCD__AT(vertex_distance)
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
#define nsvcd__weights_at NSVCD__AT(weights_at)
#define nsvcd__wigner NSVCD__AT(wigner)
#define nsvcd__winding_number NSVCD__AT(winding_number)
#define nsvcd__window_load NSVCD__AT(window_load)

// ---- the passes

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
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
#undef NSVCD__VNNI
#define NSVCD__SLICE 16
#define NSVCD__ISA _avx512
#define NSVCD__VNNI
#include "neuralsvcd.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC pop_options
#elif defined(__clang__)
#pragma clang attribute pop
#endif

// from here on names and vectors are those above again
#undef NSVCD__SLICE
#undef NSVCD__ISA
#undef NSVCD__VNNI
#define NSVCD__SLICE 4
#undef NSVCD__AT
#undef NSVCD__NUMBER_AT
#define NSVCD__AT(name) nsvcd__##name
#define NSVCD__NUMBER_AT(name) NSVCD__##name

#if defined(_MSC_VER) && !defined(__clang__)
// What the processor and the system have. Remembered in one word, to which all threads write the
// same.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  static volatile long known = -1;
  int first[4];
  int seventh[4];
  if (known >= 0) return (nsvcd__isa)known;
  __cpuid(first, 0);
  if (first[0] < 7) return NSVCD__FLAGS;
  __cpuid(first, 1);
  __cpuidex(seventh, 7, 0);
  // OSXSAVE: the system saves vector registers
  const int keeps_registers = first[2] >> 27 & 1;
  const unsigned long long kept = keeps_registers ? _xgetbv(0) : 0;
  const int fma = first[2] >> 12 & 1;
  const unsigned has = (unsigned)seventh[1];
  const unsigned bmi = has >> 3 & has >> 8 & 1;
  const int avx2 = (kept & 6) == 6 && fma && bmi && has >> 5 & 1;
  const unsigned vnni = has >> 16 & has >> 31 & (unsigned)seventh[2] >> 11 & 1;
  known = !avx2 ? NSVCD__FLAGS : (kept & 0xe0) == 0xe0 && vnni ? NSVCD__AVX512 : NSVCD__AVX2;
  return (nsvcd__isa)known;
}
#else
// What the processor and the system have. The compiler's runtime asks them before main.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  const int fma = __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (!fma || !__builtin_cpu_supports("avx2")) return NSVCD__FLAGS;
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni"))
    return NSVCD__AVX512;
  return NSVCD__AVX2;
}
#endif

#define NSVCD__KERNEL(isa, name) \
  ((isa) == NSVCD__AVX512 ? nsvcd__##name##_avx512 \
   : (isa) == NSVCD__AVX2 ? nsvcd__##name##_avx2 \
                          : nsvcd__##name)
#else
static nsvcd__isa nsvcd__isa_at_hand(void) {
  return NSVCD__FLAGS;
}
#define NSVCD__KERNEL(isa, name) ((void)(isa), nsvcd__##name)
#endif  // NSVCD__DISPATCH

// By the kernels of one instruction set. The triangles are apart when one of them is raised.
static nsvcd_result nsvcd__run_self_test(nsvcd__isa isa) {
  int right = NSVCD__KERNEL(isa, self_test_lanes)();
#ifndef NSVCD_NO_PROOF
  const volatile double height = 2.8;  // volatile, or the compiler would compute all this
  const nsvcd__d3 a[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  nsvcd__d3 b[3] = {{0.25, 0.25, -1}, {0.25, 0.25, 1}, {2, 2, 1}};
  right &= !(nsvcd__nearest_of(a, b).square > 0);
  for (size_t k = 0; k < 3; k++) b[k].z += 1 + height;
  right &= fabs(nsvcd__nearest_of(a, b).square - height * height) < 1e-9;
#endif
  return right ? NSVCD_OK : NSVCD_ERROR_BUILD;
}

NSVCDDEF nsvcd_result nsvcd_self_test(void) {
  return nsvcd__run_self_test(nsvcd__isa_at_hand());
}

// ======================================================== gradient: of distance or logit, by poses

// -------------------------------------------------------------------------------- gradient/by_pair
// In: the tape of the pair that decided an answer. Out: the derivative of its logit by the poses.
// Reverse mode, step by step from the end, over one pair. `by_x` is the derivative of the logit by
// x:
//
//   decoder     by the decoder's inputs: network/tape, for its weights are many. All else is in
//               scalars
//   pair        by the line between the centres, the velocity, and the rotations, through the frame
//               and the facts
//   instants    by the moving body's poses at t_enter, t_exit and in the middle, and by these times
//   contact     from the times to the poses at the ends of the segment in which the balls meet or
//               separate
//   poses       from the pose at any time to the caller's poses
//
// The derivative by the pose of a rigid body is a wrench: a force (by a displacement of its origin)
// and a torque (by a small rotation about that). A force f on a point at `arm` from the origin is
// the force f and the torque arm x f.

#ifndef NSVCD_NO_GRADIENT
// The derivative of |a| by a, times `by`. Where |a| is 0 to rounding it is 0, the mean of all
// directions.
static nsvcd__f3 nsvcd__by_length(nsvcd__f3 a, float by) {
  const float length = nsvcd__f3_norm(a);
  return nsvcd__f3_scale(a, length > 1e-6f ? by / length : 0);
}

// *sum += s a
static NSVCD__NOINLINE void nsvcd__add_to(nsvcd__f3 *sum, float s, nsvcd__f3 a) {
  *sum = nsvcd__f3_fma(s, a, *sum);
}

// a without its part along the unit vector n.
static nsvcd__f3 nsvcd__f3_across(nsvcd__f3 a, nsvcd__f3 n) {
  return nsvcd__f3_fma(-nsvcd__f3_dot(a, n), n, a);
}

// a's part along the unit vector n (or 0), times `along`, plus the rest, turned about n by `angle`,
// times `across`. Every linear map that commutes with rotations about n is of this form.
static nsvcd__f3 nsvcd__turned(nsvcd__f3 a, nsvcd__f3 n, float along, float across,
                               float angle) {
  const float c = across * cosf(angle);
  const float rest = (along - c) * nsvcd__f3_dot(n, a);
  const nsvcd__f3 side = nsvcd__f3_scale(n, across * sinf(angle));
  const nsvcd__f3 sum = nsvcd__f3_fma(rest, n, nsvcd__f3_scale(a, c));
  return nsvcd__f3_add(sum, nsvcd__f3_cross(side, a));
}

// The derivative by a small rotation of a latent, from its vectors x and the derivative by these,
// both (3, CHANNELS), then (5, CHANNELS). On degree 2, in the basis of nsvcd__degree2, a rotation
// by w adds to q
//   (wy q1 - wx q3 + 2 wz q4, wz q3 - wy q0 - wx (r q2 + q4), r (wx q1 - wy q3),
//    wx q0 - wz q1 + wy (r q2 - q4), wx q1 + wy q3 - 2 wz q0), where r is the root of 3.
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
    const nsvcd__f3 vector = nsvcd__f3_load(q - 3);
    const nsvcd__f3 degree1 = nsvcd__f3_cross(vector, nsvcd__f3_load(h - 3));
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

// The derivative of a logit by a pair, in the fixed body's axes and units.
typedef struct nsvcd__by_pair {
  nsvcd__f3 p1, v, w;
  nsvcd__f3 rotation;  // by a small rotation of the moving patch about its centre
} nsvcd__by_pair;

// The derivative of a logit by what the frame sees, by axis 1, and the torque on all of that, in
// the frame.
typedef struct nsvcd__by_view {
  nsvcd__f3 d, v, w, lean, axis1, torque;
} nsvcd__by_view;

// *sum += m's transpose times a
static void nsvcd__add_transpose(nsvcd__f3 *sum, const nsvcd__mat3 *m, nsvcd__f3 a) {
  nsvcd__add_to(sum, a.x, m->x);
  nsvcd__add_to(sum, a.y, m->y);
  nsvcd__add_to(sum, a.z, m->z);
}

// The adjoint of the facts: by (FACTS), added to `out`.
static void nsvcd__by_facts(const nsvcd__view *view, const float *facts, const float *by,
                            nsvcd__by_view *out) {
  const float tau = facts[NSVCD__FACT_TAU];
  const float scale = 1 / (nsvcd__f3_dot(view->v, view->v) + 1e-6f);
  const nsvcd__f3 closest = nsvcd__f3_sub(view->d, nsvcd__f3_scale(view->v, tau));
  const nsvcd__f3 by_distance = nsvcd__by_length(view->d, by[NSVCD__FACT_DISTANCE]);
  const nsvcd__f3 by_closest = nsvcd__by_length(closest, by[NSVCD__FACT_CLOSEST]);
  nsvcd__add_to(&out->d, 1, by_distance);
  nsvcd__add_to(&out->d, 1, by_closest);
  nsvcd__add_to(&out->v, -tau, by_closest);
  // where tau is not clamped
  if (fabsf(tau) < 1) {
    const float direct = by[NSVCD__FACT_TAU];
    const float by_tau = scale * (direct - nsvcd__f3_dot(by_closest, view->v));
    nsvcd__add_to(&out->d, by_tau, view->v);
    nsvcd__add_to(&out->v, by_tau, view->d);
    nsvcd__add_to(&out->v, -2 * by_tau * tau, view->v);
  }

  const nsvcd__f3 velocity = nsvcd__f3_load(facts + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 turn = nsvcd__f3_load(facts + NSVCD__FACT_TURN);
  const nsvcd__f3 by_velocity = nsvcd__f3_load(by + NSVCD__FACT_VELOCITY);
  const nsvcd__f3 by_turn = nsvcd__f3_load(by + NSVCD__FACT_TURN);
  const nsvcd__f3 mirrored = nsvcd__f3_scale(by_turn, view->side);
  nsvcd__add_transpose(&out->v, &view->frame, by_velocity);
  nsvcd__add_transpose(&out->w, &view->frame, mirrored);
  nsvcd__add_to(&out->torque, 1, nsvcd__f3_cross(velocity, by_velocity));
  nsvcd__add_to(&out->torque, 1, nsvcd__f3_cross(turn, by_turn));
  nsvcd__add_to(&out->v, 1, nsvcd__by_length(view->v, by[NSVCD__FACT_SPEED]));
  nsvcd__add_to(&out->w, 1, nsvcd__by_length(view->w, by[NSVCD__FACT_SPIN]));
}

// The adjoint of the frame in nsvcd__views_of, added to `by`. Its conventions are taken as
// constant, and turning it does the opposite of turning all that it sees.
static void nsvcd__by_frame(const nsvcd__view *view, nsvcd__by_view *by) {
  const nsvcd__f3 e1 = view->frame.x;
  const nsvcd__f3 e2 = view->frame.y;
  const nsvcd__f3 e3 = view->frame.z;
  const float length = nsvcd__f3_norm(view->d);
  const nsvcd__f3 line = nsvcd__f3_of(view->lean.x + 1e-6f, view->lean.y, view->lean.z);

  // Axis 2: the direction of a reference a, without its part along axis 1.
  nsvcd__f3 a = nsvcd__f3_add(nsvcd__f3_scale(view->lean, NSVCD__LEAN), view->v);
  nsvcd__f3 across = nsvcd__f3_across(a, e1);
  const int vanishes = nsvcd__f3_norm(across) <= 1e-7f;
  if (vanishes) {
    // the coordinate axis farthest from e1
    const float x = fabsf(e1.x);
    const float y = fabsf(e1.y);
    const float z = fabsf(e1.z);
    a = y <= z ? nsvcd__f3_of(0, 1, 0) : nsvcd__f3_of(0, 0, 1);
    if (x <= y && x <= z) a = nsvcd__f3_of(1, 0, 0);
    across = nsvcd__f3_across(a, e1);
  }
  const float about = by->torque.x / nsvcd__f3_norm(across);
  if (!vanishes) {
    nsvcd__add_to(&by->v, -about, e3);
    nsvcd__add_to(&by->lean, -about * NSVCD__LEAN, e3);
  }

  // Axis 1: the direction of the line, or of what replaces it.
  nsvcd__f3 by_e1 = nsvcd__f3_across(by->axis1, e1);
  nsvcd__add_to(&by_e1, by->torque.y + about * nsvcd__f3_dot(e1, a), e3);
  nsvcd__add_to(&by_e1, -by->torque.z, e2);
  if (length > 1e-5f)
    nsvcd__add_to(&by->d, 1 / length, by_e1);
  else if (nsvcd__f3_norm(line) > 1e-9f)
    nsvcd__add_to(&by->lean, 1 / nsvcd__f3_norm(line), by_e1);
}

// ---- gaps

// As nsvcd__turned_back, by tau w. With -tau it is the adjoint by u.
static nsvcd__f3 nsvcd__f3_turned_back(nsvcd__f3 u, nsvcd__f3 w, float tau) {
  const nsvcd__f3 turned = nsvcd__f3_fma(tau, nsvcd__f3_cross(u, w), u);
  const float along = 0.5f * tau * tau * nsvcd__f3_dot(u, w);
  const float less = -0.5f * tau * tau * nsvcd__f3_dot(w, w);
  return nsvcd__f3_fma(less, u, nsvcd__f3_fma(along, w, turned));
}

// The derivative of nsvcd__turned_back(u, w, tau) . q by w.
static nsvcd__f3 nsvcd__turned_back_by_w(nsvcd__f3 u, nsvcd__f3 w, float tau, nsvcd__f3 q) {
  const float half = 0.5f * tau * tau;
  nsvcd__f3 out = nsvcd__f3_scale(nsvcd__f3_cross(q, u), tau);
  nsvcd__add_to(&out, half * nsvcd__f3_dot(w, q), u);
  nsvcd__add_to(&out, half * nsvcd__f3_dot(u, w), q);
  return nsvcd__f3_fma(-2 * half * nsvcd__f3_dot(u, q), w, out);
}

// The extreme point of a patch that is farthest along u, in 1/127 of the radius.
static nsvcd__f3 nsvcd__farthest_extreme(const int8_t *extremes, nsvcd__f3 u) {
  nsvcd__f3 best = {0, 0, 0};
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += 3 * NSVCD__GROUP) {
    const nsvcd__f3 extreme =
        nsvcd__f3_of(extremes[0], extremes[NSVCD__GROUP], extremes[2 * NSVCD__GROUP]);
    if (k == 0 || nsvcd__f3_dot(extreme, u) > nsvcd__f3_dot(best, u)) best = extreme;
  }
  return best;
}

// The adjoint of a gap along u at tau, times `by`, added to `out`; returns that by u. extremes: of
// the moving patch and of the fixed one. moves: 0 at rest, else 1.
static NSVCD__NOINLINE nsvcd__f3 nsvcd__by_gap(const nsvcd__pair *pair,
                                               const int8_t *const *extremes, nsvcd__f3 u,
                                               float tau, float moves, float by,
                                               nsvcd__by_pair *out) {
  const float half = 0.5f * tau;
  const nsvcd__f3 w = pair->w;
  const nsvcd__f3 back = nsvcd__f3_turned_back(u, w, half);
  const nsvcd__f3 forth = nsvcd__f3_turned_back(u, w, -half);
  const nsvcd__f3 own = nsvcd__mat3_apply_transpose(&pair->rotation, back);
  const nsvcd__f3 lowest = nsvcd__farthest_extreme(extremes[0], nsvcd__f3_scale(own, -1));
  const nsvcd__f3 highest = nsvcd__farthest_extreme(extremes[1], forth);
  const nsvcd__f3 turned = nsvcd__mat3_apply(&pair->rotation, lowest);
  const nsvcd__f3 q = nsvcd__f3_scale(turned, pair->r1 / 127);
  const nsvcd__f3 x = nsvcd__f3_scale(highest, pair->r2 / 127);
  const nsvcd__f3 on_q = nsvcd__turned_back_by_w(u, w, half, q);
  const nsvcd__f3 on_x = nsvcd__turned_back_by_w(u, w, -half, x);
  nsvcd__add_to(&out->p1, by, u);
  nsvcd__add_to(&out->v, moves * tau * by, u);
  nsvcd__add_to(&out->w, moves * by, nsvcd__f3_sub(on_q, on_x));
  nsvcd__add_to(&out->rotation, by, nsvcd__f3_cross(q, back));
  nsvcd__f3 by_u = nsvcd__f3_fma(tau, pair->v, nsvcd__f3_sub(pair->p1, pair->p2));
  nsvcd__add_to(&by_u, 1, nsvcd__f3_turned_back(q, w, -half));
  nsvcd__add_to(&by_u, -1, nsvcd__f3_turned_back(x, w, half));
  return nsvcd__f3_scale(by_u, by);
}

// The adjoint of nsvcd__gap_fact. size: the gap's absolute value.
static float nsvcd__by_gap_fact(float by, float size, float steep) {
  return by * steep / ((1 + steep * size) * (1 + steep * size));
}

// The adjoint of nsvcd__gap_axes_of: from the derivatives by the axes u (GAPS) to those by the line
// between the centres, added to `out`, and by the moving patch's normal, which is returned.
static nsvcd__f3 nsvcd__by_gap_axes(const nsvcd__pair *pair, const nsvcd__view *view,
                                    const nsvcd__f3 *u, const nsvcd__f3 *by_u,
                                    nsvcd__by_pair *out) {
  const nsvcd__f3 line = u[NSVCD__GAP_LINE];
  const int has_fixed = nsvcd__f3_norm(pair->normal[1]) > 0.5f;
  const int has_moving = nsvcd__f3_norm(view->normal) > 0.5f;
  const size_t of_moving = view->swap > 0 ? NSVCD__GAP_LARGER : NSVCD__GAP_SMALLER;
  const size_t of_fixed = view->swap > 0 ? NSVCD__GAP_SMALLER : NSVCD__GAP_LARGER;
  const nsvcd__f3 from = has_fixed ? pair->normal[1] : line;
  const nsvcd__f3 to = has_moving ? nsvcd__f3_scale(view->normal, -1) : line;
  const float length = nsvcd__f3_norm(nsvcd__f3_add(from, to));
  // An axis is the direction of a constant, plus multiples of the moving patch's normal, reversed,
  // and of the line.
  float normals[NSVCD__GAPS] = {0};
  float lines[NSVCD__GAPS] = {0};
  normals[of_moving] = has_moving ? 1 : 0;
  lines[of_moving] = has_moving ? 0 : 1;
  lines[of_fixed] = has_fixed ? 0 : 1;
  lines[NSVCD__GAP_LINE] = 1;
  lines[NSVCD__GAP_BOTH] = 1;
  if (length > 1e-3f) {
    normals[NSVCD__GAP_BOTH] = normals[of_moving] / length;
    lines[NSVCD__GAP_BOTH] = (lines[of_fixed] + lines[of_moving]) / length;
  }
  nsvcd__f3 by_normal = {0, 0, 0};
  nsvcd__f3 by_line = {0, 0, 0};
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__f3 across = nsvcd__f3_across(by_u[d], u[d]);
    nsvcd__add_to(&by_normal, -normals[d], across);
    nsvcd__add_to(&by_line, lines[d], across);
  }
  const float distance = nsvcd__f3_norm(nsvcd__f3_sub(pair->p1, pair->p2));
  const float inverse = 1 / fmaxf(distance, 1e-20f);
  nsvcd__add_to(&out->p1, inverse, nsvcd__f3_across(by_line, line));
  return by_normal;
}

// The adjoint of nsvcd__gap_facts, and of the facts about normals: by (FACTS), added to `out` and,
// by axis 1, to `seen`. moves: 0 at rest, else 1.
static void nsvcd__by_gaps(const nsvcd__tape *tape, float moves, const float *by,
                           nsvcd__by_pair *out, nsvcd__by_view *seen) {
  const nsvcd__pair *pair = &tape->pair;
  const nsvcd__view *view = &tape->view;
  const nsvcd__f3 *u = tape->axes;
  const nsvcd__f3 fixed = pair->normal[1];
  nsvcd__f3 by_u[NSVCD__GAPS];
  memset(by_u, 0, sizeof by_u);
  for (size_t m = 0; m < NSVCD__MOMENTS; m++) {
    const float tau = view->time * ((float)m - 1);
    const float *wide = tape->gaps[m];
    size_t widest = 0;
    for (size_t d = 1; d < NSVCD__GAPS; d++) widest = wide[d] > wide[widest] ? d : widest;
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      const float size = fabsf(view->inverse * wide[d]);
      const float own = by[NSVCD__FACT_GAPS + NSVCD__MOMENTS * d + m];
      const float most = d == widest ? by[NSVCD__FACT_WIDEST + m] : 0;
      const float by_own = nsvcd__by_gap_fact(own, size, NSVCD__GAP_STEEP);
      const float by_most = nsvcd__by_gap_fact(most, size, NSVCD__WIDEST_STEEP);
      const float by_gap = view->inverse * (by_own + by_most);
      const nsvcd__f3 more =
          nsvcd__by_gap(pair, tape->extremes, u[d], tau, moves, by_gap, out);
      nsvcd__add_to(&by_u[d], 1, more);
    }
  }

  nsvcd__f3 by_normal = nsvcd__by_gap_axes(pair, view, u, by_u, out);
  const float *facing = by + NSVCD__FACT_FACING;
  const float to_moving = view->swap > 0 ? facing[1] : facing[2];
  const float to_fixed = view->swap > 0 ? facing[2] : facing[1];
  nsvcd__add_to(&by_normal, facing[0], fixed);
  nsvcd__add_to(&by_normal, to_moving, view->frame.x);
  nsvcd__add_to(&seen->axis1, to_moving, view->normal);
  nsvcd__add_to(&seen->axis1, to_fixed, fixed);
  nsvcd__add_to(&out->rotation, 1, nsvcd__f3_cross(view->normal, by_normal));
}

// The adjoint of nsvcd__invariants. The unit of length is taken as constant.
static void nsvcd__by_invariants(const nsvcd__tape *tape, nsvcd__by_pair *by) {
  const nsvcd__view view = tape->view;
  const float *x = tape->x;
  const float *by_x = tape->by_x;
  // The direction of time; 0 at rest, to rounding: the logit is even in the motion, with a kink
  // there, and the mean of its two sides is 0.
  const float moves = nsvcd__f3_dot(view.v, view.v) + nsvcd__f3_dot(view.w, view.w);
  const float sign = moves < 1e-12f ? 0.0f : view.time * view.swap;

  // torques in the frame: on the moving patch's latent, then on all that the frame sees
  const size_t facts = 2 * NSVCD__LATENT;
  const size_t first = view.swap > 0 ? 0 : NSVCD__VECTORS;
  const size_t second = NSVCD__VECTORS - first;
  const nsvcd__f3 on_moving = nsvcd__latent_torque(x + first, by_x + first);
  const nsvcd__f3 on_fixed = nsvcd__latent_torque(x + second, by_x + second);
  nsvcd__by_view seen;
  memset(&seen, 0, sizeof seen);
  seen.torque = nsvcd__f3_add(on_moving, on_fixed);
  nsvcd__by_facts(&view, x + facts, by_x + facts, &seen);
  memset(by, 0, sizeof *by);
  nsvcd__by_gaps(tape, fabsf(sign), by_x + facts, by, &seen);
  nsvcd__by_frame(&view, &seen);

  const nsvcd__f3 lean1 = nsvcd__f3_scale(view.normal, view.swap * view.k1);
  const nsvcd__f3 turned = nsvcd__f3_scale(on_moving, view.side);
  nsvcd__add_transpose(&by->rotation, &view.frame, turned);
  nsvcd__add_to(&by->rotation, 1, nsvcd__f3_cross(lean1, seen.lean));
  nsvcd__add_to(&by->p1, -view.swap * view.inverse, seen.d);
  nsvcd__add_to(&by->v, sign * view.inverse, seen.v);
  nsvcd__add_to(&by->w, sign, seen.w);
}
#endif  // NSVCD_NO_GRADIENT

// ------------------------------------------------------------------------------- gradient/gradient
// In: derivatives by a pair. Out: those by the poses of both movers.

#ifndef NSVCD_NO_GRADIENT
// Adds a force and a torque, times `scale`, to a wrench, row (6).
static NSVCD__NOINLINE void nsvcd__add_wrench(float scale, nsvcd__f3 force, nsvcd__f3 torque,
                                              float *row) {
  nsvcd__f3_store(nsvcd__f3_fma(scale, force, nsvcd__f3_load(row)), row);
  nsvcd__f3_store(nsvcd__f3_fma(scale, torque, nsvcd__f3_load(row + 3)), row + 3);
}

// Adds what a force on a pivot c, and a torque about it, are by a pose.
static void nsvcd__add_at_pivot(const nsvcd_pose *pose, nsvcd__d3 c, nsvcd__f3 force,
                                nsvcd__f3 torque, float *row) {
  const nsvcd__d3 pivot = nsvcd__pivot_of(pose, c);
  const nsvcd__d3 origin = nsvcd__d3_load(pose->position);
  const nsvcd__f3 arm = nsvcd__d3_narrow(nsvcd__d3_sub(pivot, origin));
  const nsvcd__f3 moment = nsvcd__f3_cross(arm, force);
  nsvcd__add_wrench(1, force, nsvcd__f3_add(torque, moment), row);
}

// Adds to `gradient` (count, 6), or NULL, what a force on a body's pivot and a torque about it at
// time t, in the world, are by its poses before and after t. Returns the derivative by t. Let R =
// exp(2 u h n) A, on the shorter arc from A to B = exp(2 h n) A. Small rotations a of A and b of B
// (on the left) turn R
//   along n    by (1 - u) a + u b,
//   across n   by sin((1 - u) h) / sin h of a, turned by u h about n,
//              and sin(u h) / sin h of b, turned by -(1 - u) h.
static float nsvcd__by_poses(const nsvcd__track *track, float t, nsvcd__f3 force,
                             nsvcd__f3 torque, float *out) {
  if (track->count == 1) {
    if (out) nsvcd__add_wrench(1, force, torque, out);
    return 0;
  }
  float u;
  const size_t k = nsvcd__pose_at(track, t, &u);
  const float *times = track->times;
  const float per_t = times ? 1 / (times[k + 1] - times[k]) : (float)(track->count - 1);
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = &track->poses[k + 1];
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  // From a to b on the shorter arc: a turn by 2 h about the unit vector n, or 0 if nothing turns.
  const nsvcd__quat qa = nsvcd__quat_unit(nsvcd__quat_load(a->rotation));
  const nsvcd__quat qb = nsvcd__quat_unit(nsvcd__quat_load(b->rotation));
  const nsvcd__quat nearer = nsvcd__quat_beside(qb, nsvcd__poses_opposed(a, b));
  const nsvcd__f3 axis = nsvcd__quat_turn(qa, nearer);
  const float sine = nsvcd__f3_norm(axis);
  const float inverse = sine > 0 ? 1 / sine : 0;
  const nsvcd__f3 n = nsvcd__f3_scale(axis, inverse);
  const float h = nsvcd__quat_arc(qa, nearer);
  if (out) {
    const float wa = h > 1e-3f ? sinf((1 - u) * h) * inverse : 1 - u;
    const float wb = h > 1e-3f ? sinf(u * h) * inverse : u;
    const nsvcd__f3 on_a = nsvcd__turned(torque, n, 1 - u, wa, -u * h);
    const nsvcd__f3 on_b = nsvcd__turned(torque, n, u, wb, (1 - u) * h);
    nsvcd__add_at_pivot(a, pivot, nsvcd__f3_scale(force, 1 - u), on_a, out + 6 * k);
    nsvcd__add_at_pivot(b, pivot, nsvcd__f3_scale(force, u), on_b, out + 6 * (k + 1));
  }
  const nsvcd__d3 from = nsvcd__pivot_of(a, pivot);
  const nsvcd__d3 to = nsvcd__pivot_of(b, pivot);
  const nsvcd__f3 moved = nsvcd__d3_narrow(nsvcd__d3_sub(to, from));
  const float by_turn = 2 * h * nsvcd__f3_dot(torque, n);
  return per_t * (nsvcd__f3_dot(force, moved) + by_turn);
}

// ---- instants and contact

// The instants' times. time: of the segments' ends.
static void nsvcd__instants_of(const nsvcd__candidate *c, const float *time,
                               nsvcd__instants *at) {
  const float t0 = c->t_enter;
  const float t1 = c->t_exit;
  size_t a = 0;
  size_t b = 0;
  while (!(t0 < time[a + 1]) && time[a + 1] < 1) a++;
  while (!(t1 <= time[b + 1]) && time[b + 1] < 1) b++;
  const float t[] = {t0, t1, 0.5f * (t0 + t1), time[a], time[a + 1], time[b], time[b + 1]};
  memcpy(at->t, t, sizeof t);
  at->enters = time[a] < t0 && t0 < time[a + 1];
  at->leaves = time[b] < t1 && t1 < time[b + 1];
}

// A track's pose at time t in [0,1].
static nsvcd__world_pose nsvcd__track_pose_at(const nsvcd__track *track, float t) {
  const nsvcd__d3 pivot = nsvcd__track_pivot(track);
  if (track->count == 1) return nsvcd__world_pose_of(track->poses, pivot);
  float fraction;
  const size_t k = nsvcd__pose_at(track, t, &fraction);
  const nsvcd_pose *a = &track->poses[k];
  return nsvcd__world_pose_between(a, a + 1, pivot, (double)fraction);
}

// Adds to out (2), of which one may be NULL, what a force on the patch's centre at instant l and a
// torque on the moving body, in the fixed body's axes and units, are by the poses of the moving
// body and of the fixed one. The two wrenches are opposite. Returns the derivative by the time.
static float nsvcd__by_instant(const nsvcd__motion *m, nsvcd__instants *at, size_t l,
                               nsvcd__f3 force, nsvcd__f3 torque, float *const *out) {
  const float t = at->t[l];
  const float unit = m->unit;
  const nsvcd__world_pose moving = nsvcd__track_pose_at(&m->moving, t);
  const nsvcd__world_pose fixed = nsvcd__track_pose_at(&m->fixed, t);
  const nsvcd__mat3 axes = nsvcd__mat3_of(fixed.rotation);
  const nsvcd__f3 arm = nsvcd__d3_narrow(nsvcd__d3_sub(moving.position, fixed.position));
  const nsvcd__f3 moment = nsvcd__f3_cross(nsvcd__lane_of(at->arm, l), force);
  const nsvcd__f3 seen = nsvcd__mat3_apply(&axes, force);
  const nsvcd__f3 push = nsvcd__f3_of(seen.x / unit, seen.y / unit, seen.z / unit);
  const nsvcd__f3 turn = nsvcd__mat3_apply(&axes, nsvcd__f3_add(torque, moment));
  const nsvcd__f3 back = nsvcd__f3_scale(push, -1);
  const nsvcd__f3 turn_back = nsvcd__f3_sub(nsvcd__f3_cross(arm, back), turn);
  const float by_moving = nsvcd__by_poses(&m->moving, t, push, turn, out[0]);
  return by_moving + nsvcd__by_poses(&m->fixed, t, back, turn_back, out[1]);
}

// The adjoint of the time at which the balls meet (ENTRY) or separate (EXIT). There y = x0 +
// tau x - c, where x is the segment's chord, is as long as the sum of the radii, and so y.(dy + x
// dtau) = 0. If the balls only graze (y across x), the derivative has no limit: it is bounded where
// float32 has no digits left.
static void nsvcd__by_contact(const nsvcd__motion *m, nsvcd__instants *at, size_t l,
                              nsvcd__f3 centre, float by_time, float *const *out) {
  const nsvcd__f3 none = {0, 0, 0};
  const size_t s = l == NSVCD__ENTRY ? NSVCD__ENTRY_BEGIN : NSVCD__EXIT_BEGIN;
  const float length = at->t[s + 1] - at->t[s];
  const nsvcd__f3 start = nsvcd__lane_of(at->position, s);
  const float tau = (at->t[l] - at->t[s]) / length;
  const nsvcd__f3 chord = nsvcd__f3_sub(nsvcd__lane_of(at->position, s + 1), start);
  const nsvcd__f3 from = nsvcd__f3_sub(start, centre);
  const nsvcd__f3 y = nsvcd__f3_fma(tau, chord, from);
  const float least = 1e-3f * nsvcd__f3_norm(y) * nsvcd__f3_norm(chord);
  const float dot = fabsf(nsvcd__f3_dot(y, chord));
  if (!(least > 0)) return;
  const float along = l == NSVCD__ENTRY ? length : -length;
  const float rate = along * by_time / (dot > least ? dot : least);
  const nsvcd__f3 before = nsvcd__f3_scale(y, (1 - tau) * rate);
  const nsvcd__f3 after = nsvcd__f3_scale(y, tau * rate);
  nsvcd__by_instant(m, at, s, before, none, out);
  nsvcd__by_instant(m, at, s + 1, after, none, out);
}

// Adds the derivative of the decisive distance, or logit, of a question that the network has
// answered, by the poses to out (2).
static NSVCD__NOINLINE void nsvcd__gradient(const nsvcd__query *query, float *const *out) {
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *m = &task->motion;
  nsvcd__tape tape;
  nsvcd__instants *at = &tape.at;
  nsvcd__by_pair by;
  nsvcd__instants_of(&task->decisive->candidate, query->broad_phase.time, at);
  NSVCD__KERNEL(query->isa, record)(task, &tape);
  nsvcd__by_invariants(&tape, &by);

  // The adjoint of nsvcd__pairs_of. v = w x arm + (x1 - x0) / 2, where arm goes from the moving
  // centre half way to the other.
  const nsvcd__f3 w = tape.pair.w;
  const nsvcd__f3 middle = nsvcd__lane_of(at->position, NSVCD__MIDDLE);
  const nsvcd__f3 line = nsvcd__f3_sub(tape.pair.p2, middle);
  const nsvcd__f3 arm = nsvcd__f3_scale(line, 0.5f);
  nsvcd__add_to(&by.p1, -0.5f, nsvcd__f3_cross(by.v, w));
  nsvcd__add_to(&by.w, 1, nsvcd__f3_cross(arm, by.v));
  // w is half the rotation vector of R1 R0^-1: small rotations of R0 and R1 turn it as
  // nsvcd__by_poses says.
  const nsvcd__f3 none = {0, 0, 0};
  float by_time[2];
  const float h = nsvcd__f3_norm(w);
  const float half = 0.5f * (h > 1e-3f ? h / sinf(h) : 1);
  const nsvcd__f3 n = h > 0 ? nsvcd__f3_of(w.x / h, w.y / h, w.z / h) : none;
  const float by_middle = nsvcd__by_instant(m, at, NSVCD__MIDDLE, by.p1, by.rotation, out);
  for (size_t l = NSVCD__ENTRY; l <= NSVCD__EXIT; l++) {
    const float side = l == NSVCD__ENTRY ? -1.0f : 1.0f;
    const nsvcd__f3 force = nsvcd__f3_scale(by.v, 0.5f * side);
    const nsvcd__f3 torque = nsvcd__turned(by.w, n, 0.5f * side, half * side, h * side);
    by_time[l] = 0.5f * by_middle + nsvcd__by_instant(m, at, l, force, torque, out);
  }
  if (at->enters) nsvcd__by_contact(m, at, NSVCD__ENTRY, tape.pair.p2, by_time[0], out);
  if (at->leaves) nsvcd__by_contact(m, at, NSVCD__EXIT, tape.pair.p2, by_time[1], out);
}
#endif  // NSVCD_NO_GRADIENT

// =============================================================== query: a question, and its answer

// ----------------------------------------------------------------------------------- query/verdict
// In: a goal, and the segments chosen of a motion or of an interval of it. Out: a result: do the
// bodies meet; where asked, when first, and how near they come.
//
// Goals and results are values. What stands here and above asks the waist, the kernel
// nsvcd__separate, with goals of its own, and writes nothing into the proof but whose motion it is
// about.

#ifndef NSVCD_NO_PROOF
// The tick before which nothing meets, or NEVER.
static double nsvcd__clear_until(const nsvcd__solver *w, const nsvcd__search_result *r) {
  if (w->unclear) return 0;
  return nsvcd__min(nsvcd__min(r->end, r->unresolved),
                    r->ran_out ? r->proven_until : NSVCD__NEVER);
}

// Has a search found two triangles that can be named: in contact, or too near to tell?
static int nsvcd__has_pair(const nsvcd__search_result *r) {
  return r->has_contact || r->unresolved < NSVCD__NEVER;
}

// Forgets all that was known of a motion, or of an interval, before another one is searched.
static void nsvcd__restart(nsvcd__solver *w, nsvcd__motion *motion) {
  nsvcd__proof *p = &w->p;
  memset(&p->known, 0, sizeof p->known);
  nsvcd__arcs_begin(&p->arcs, motion);
  p->known.proven_until = (double)motion->from;
  p->known.end = w->clipped_end = p->known.unresolved = NSVCD__NEVER;
  w->clipped = 0;
  w->count = w->fresh_count = w->misses = p->push.contact_count = 0;
  p->shared = w->blocks.window = 0;
  p->push.too_deep = w->blocks.has_block = 0;
  p->separating = nsvcd__d3_of(0, 0, 0);
  memset(&w->memo, 0, sizeof w->memo);
}

// Searches any motion, from scratch.
static nsvcd__search_result nsvcd__search_anew(nsvcd__solver *w, nsvcd__search *q,
                                               nsvcd__goal goal) {
  nsvcd__restart(w, goal.motion);
  nsvcd__choose_segments(goal.motion, q);
  return NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
}

// The pose at the start of a motion, or at its end, as a motion of its own.
static nsvcd__motion nsvcd__end_of(const nsvcd__motion *m, int at_end) {
  nsvcd__motion still = *m;
  nsvcd__track moving = m->moving;
  nsvcd__track fixed = m->fixed;
  moving.poses += at_end ? moving.count - 1 : 0;
  fixed.poses += at_end ? fixed.count - 1 : 0;
  moving.count = fixed.count = 1;
  moving.times = fixed.times = NULL;
  still.begin = at_end ? 1 : 0;
  still.duration = 0;
  nsvcd__motion_set_tracks(&still, moving, fixed);
  return still;
}

// Do triangles meet at the start alone, or at the end? Takes so many units at most. If they do, the
// result is that contact.
static NSVCD__NOINLINE int nsvcd__meets_at(nsvcd__solver *w, nsvcd__search *q,
                                           nsvcd__goal goal, int at_end, size_t units,
                                           nsvcd__search_result *out) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *whole = goal.motion;
  nsvcd__motion still = nsvcd__end_of(whole, at_end);
  goal.motion = &still;
  goal.fraction = 0;
  goal.limit = nsvcd__limit_after(p, &goal, units);
  goal.is_brief = 1;
  const nsvcd__search_result at = nsvcd__search_anew(w, q, goal);
  nsvcd__arcs_begin(&p->arcs, whole);
  if (at.outcome != NSVCD__ANSWERED) return 0;
  *out = at;
  out->found.tick = at_end ? (double)whole->ticks : 0;
  out->end = 0;
  return 1;
}

// Searches segments that have been chosen, first with a small budget: most queries end there. Many
// of the rest touch only at the start or at the end, so these two poses are tried before all is
// searched again. The search for a first contact begins at the start anyway, and the ends of a long
// motion have been tried before its intervals.
static nsvcd__search_result nsvcd__search_whole(nsvcd__solver *w, nsvcd__search *q,
                                                nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  const size_t limit = goal.limit;
  const int may_be_brief = !goal.motion->arcs && !(goal.fraction > 0);
  goal.is_brief = may_be_brief && p->work + NSVCD__BRIEF_BUDGET < limit;
  if (goal.is_brief) goal.limit = p->work + NSVCD__BRIEF_BUDGET;
  nsvcd__search_result result = NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
  if (result.outcome != NSVCD__EXHAUSTED || !goal.is_brief) return result;
  // half of what may follow an unresolved pair has been used
  if (result.unresolved < NSVCD__NEVER) goal.after_unresolved -= goal.after_unresolved / 2;
  for (int at_end = 0; at_end < 2; at_end++) {
    if (nsvcd__meets_at(w, q, goal, at_end, NSVCD__END_BUDGET, &result)) return result;
  }
  goal.is_brief = 0;
  goal.limit = limit;
  return nsvcd__search_anew(w, q, goal);
}

// Searches a part of the motion, from one position in segments to another, for the first contact
// there or the first unresolved pair, and adds what it finds to what is known of all before it.
static void nsvcd__search_part(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal,
                               double from, double to, nsvcd__search_result *known) {
  nsvcd__restart(w, goal.motion);
  nsvcd__choose_segments(goal.motion, q);
  // this many ticks to one of before
  const double finer = nsvcd__motion_refine(goal.motion);
  nsvcd__narrow_segments(q, from, to, finer);
  goal.end = nsvcd__min(NSVCD__NEVER, finer * known->end);
  goal.unresolved_ends = 1;
  const nsvcd__search_result part = NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
  if (part.has_contact) {
    known->has_contact = 1;
    known->found = part.found;
    known->found.tick /= finer;
    known->end = part.end / finer;
  }
  known->ran_out = part.ran_out;
  if (part.ran_out) return;
  if (part.unresolved < NSVCD__NEVER) {
    known->unresolved_pair = part.unresolved_pair;
    known->unresolved_pair.tick /= finer;
    known->unresolved = part.unresolved / finer;
  }
  known->proven_until = nsvcd__min((double)q->begin[q->segments], part.end) / finer;
}

// The budget did not suffice for the first contact. Searches again by time, from what is proven on:
// one part of the motion after another, a shorter one where a part takes too many units.
static NSVCD__NOINLINE void nsvcd__search_by_time(nsvcd__solver *w, nsvcd__search *q,
                                                  nsvcd__goal goal,
                                                  nsvcd__search_result *known) {
  nsvcd__proof *p = &w->p;
  const size_t limit = goal.most;
  const double ticks = (double)goal.motion->ticks;
  const double all = (double)q->segments;
  double from = 0;
  double length = NSVCD__FIRST_PART;
  double grows = 4;
  size_t units = limit;
  while (from < all && (double)q->begin[(size_t)from + 1] <= known->proven_until) from++;
  goal.is_brief = 1;
  for (;;) {
    const double until = nsvcd__min(ticks, nsvcd__min(known->end, known->unresolved));
    known->ran_out = known->proven_until < until;
    if (!known->ran_out || p->work >= limit) break;
    const size_t before = p->work;
    const double whole = floor(from + length);
    const double to = whole > from ? nsvcd__min(whole, all) : from + length;
    goal.limit = limit - before > units ? before + units : limit;
    nsvcd__search_part(w, q, goal, from, to, known);
    if (known->ran_out) {
      length /= 8;
      grows = 2;
    } else {
      from = to;
      length *= grows;
      units = 8 * (p->work - before) + NSVCD__PART_BUDGET;
    }
  }
  nsvcd__restart(w, goal.motion);
  nsvcd__choose_segments(goal.motion, q);
}

// When do they meet first? What is proven of that stays proven when the budget ends.
static nsvcd__search_result nsvcd__search_first(nsvcd__solver *w, nsvcd__search *q,
                                                nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  goal.limit = nsvcd__limit_of_first(&p->given, &goal);
  nsvcd__search_result result = nsvcd__search_whole(w, q, goal);
  // An interval is short, and all before it is known.
  if (result.ran_out && !goal.motion->arcs) nsvcd__search_by_time(w, q, goal, &result);
  if (!result.has_contact) return result;
  if (goal.motion->from > 0) {
    result.starts_free = 1;
  } else if (nsvcd__clear_until(w, &result) <= 0 && result.found.tick > 0) {
    // The contact is so early that they may meet at the start already.
    if (nsvcd__meets_at(w, q, goal, 0, p->given.work, &result)) return result;
    result.starts_free = !p->known.ran_out && !(p->known.unresolved < NSVCD__NEVER);
  }
  return result;
}

// ---- the least distance

// The bracket of the least distance.
typedef struct nsvcd__bracket {
  double low, high;
  // the budget did not suffice for the resolution asked for
  int is_wide;
} nsvcd__bracket;

// One pass: a search whose question shrinks, for a bracket as narrow as goal.measure. Adds what it
// finds to what is known, and narrows the bracket. Returns 0 if the budget did not suffice.
static int nsvcd__measure_once(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal,
                               nsvcd__bracket *bracket, nsvcd__search_result *known) {
  goal.low = bracket->low;
  goal.high = bracket->high;
  goal.clearance =
      nsvcd__has_pair(known) ? nsvcd__max(goal.low, goal.high - goal.measure) : goal.high;
  nsvcd__restart(w, goal.motion);
  const nsvcd__search_result pass = NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
  if (pass.has_contact) {
    known->has_contact = 1;
    known->found = pass.found;
    bracket->high = pass.found.distance;
  }
  if (pass.outcome == NSVCD__EXHAUSTED) return 0;
  bracket->low = pass.clearance;
  return 1;
}

// Makes the bracket as narrow as `finest`. If half of the budget does not suffice for that, the
// rest goes to brackets that get narrower and narrower; the last that was completed stays. work:
// the budget.
static void nsvcd__narrow(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal, size_t work,
                          double finest, nsvcd__bracket *bracket,
                          nsvcd__search_result *known) {
  goal.measure = finest;
  goal.limit = nsvcd__limit_after(&w->p, &goal, work / 2);
  if (nsvcd__measure_once(w, q, goal, bracket, known)) return;
  goal.limit = goal.most;
  goal.measure = bracket->high - bracket->low;
  while (!bracket->is_wide && goal.measure > finest) {
    goal.measure = nsvcd__max(finest, goal.measure / NSVCD__FINER);
    bracket->is_wide = !nsvcd__measure_once(w, q, goal, bracket, known);
  }
}
#endif  // NSVCD_NO_PROOF

// -------------------------------------------------------------------------------------- query/long
// In: a question about a motion of any length. Out: the verdict; where asked, when the bodies first
// meet, and how near they come.
//
// A motion that is too long for one search (motion/choice) is searched interval by interval, in the
// order of time, each as if it were all of the motion: memory is needed for one. The motion is free
// if all intervals are. Containment is decided once, at t = 0: what is inside of what later on, and
// not then, has crossed a surface in between. A contact in any interval answers a yes or no, so the
// ends of the motion, where most contacts are, are tried first. The first contact is in the first
// interval that has one. An interval that stays unresolved before it ends what is proven, and from
// there on the question is only whether they meet at all. For the least distance each contact
// lowers the bound, and later intervals need only stay beyond it.
//
// Most of a long motion is far from anything, or easy. So a *try* takes many more arcs than an
// interval has, with a small budget. If that does not suffice, it is searched in smaller parts.

#ifndef NSVCD_NO_PROOF
// How fast intervals go through a motion: how many in a row have been easy, and how many must be
// before the next try.
typedef struct nsvcd__pace {
  uint32_t easy, wait;
} nsvcd__pace;

// The arcs of the first interval: all of the motion, as a try.
#define NSVCD__ALL_ARCS 0xffffffffu

// Chooses the next interval: larger if those before took little work; with segments that turn less
// if the one before took much; a part of a try that failed.
static void nsvcd__next_interval(nsvcd__motion *m, nsvcd__search *q, uint32_t until,
                                 int is_resolved, size_t units, nsvcd__pace *pace) {
  uint32_t arcs = m->arcs;
  if (!is_resolved) {
    arcs = arcs > NSVCD__SMALLER ? arcs / NSVCD__SMALLER : 1;
    if (arcs == 1 && pace->wait < NSVCD__WAIT) pace->wait *= 2;
    pace->easy = 0;
  } else if (arcs > 1) {
    arcs *= NSVCD__LARGER;
    pace->wait = 1;
  } else {
    pace->easy = units <= NSVCD__EASY ? pace->easy + 1 : 0;
    if (pace->easy >= pace->wait) arcs = NSVCD__LARGER;
    m->is_fine = units > NSVCD__TRY;
  }
  if (is_resolved) m->from = until;
  if (m->from < m->ticks) nsvcd__choose_interval(m, q, m->from, arcs);
}

// The surfaces of bodies whose origins stay so far apart come no nearer than this.
static float nsvcd__surface_gap(const nsvcd__proof *p, const nsvcd__motion *m,
                                float origin_gap) {
  return origin_gap - p->given.lengths - 1.0001f * nsvcd__f3_norm(m->push_out);
}

// Searches a motion interval by interval, until a contact answers. In the end that contact is
// known, and all else that is known is of the first interval that was not resolved.
static NSVCD__NOINLINE nsvcd__search_result nsvcd__search_intervals(nsvcd__solver *w,
                                                                    nsvcd__search *q,
                                                                    nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  double fraction = goal.fraction;  // 0: any contact will do
  const nsvcd__given *given = &p->given;
  nsvcd__search_result result = p->known;
  nsvcd__search_result open = result;
  int is_open = 0;
  const size_t units = given->reserve < NSVCD__END_BUDGET ? given->reserve : NSVCD__END_BUDGET;
  for (int at_end = 0; at_end < 2 && !(fraction > 0); at_end++) {
    if (nsvcd__meets_at(w, q, goal, at_end, units, &result)) return result;
  }
  nsvcd__pace pace = {0, 1};
  nsvcd__choose_interval(m, q, 0, NSVCD__ALL_ARCS);
  while (m->from < m->ticks) {
    const uint32_t until = q->begin[q->segments];
    const int is_try = m->arcs > 1;
    const size_t before = p->work;
    if (given->grows) goal.most = p->work + given->work;
    nsvcd__restart(w, m);
    result = p->known;
    const float gap = nsvcd__interval_gap(m, m->from, until);
    if (!(nsvcd__surface_gap(p, m, gap) > nsvcd__clearance(&goal))) {
      goal.is_brief = is_try;
      goal.fraction = is_try ? 0 : fraction;
      goal.after_unresolved = fraction > 0 ? NSVCD__AFTER_FIRST_UNRESOLVED : given->reserve;
      goal.limit = is_try ? nsvcd__limit_after(p, &goal, NSVCD__TRY) : goal.most;
      result = goal.fraction > 0 ? nsvcd__search_first(w, q, goal)
                                 : NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
    }
    const int is_resolved =
        result.outcome == NSVCD__DONE && !(result.unresolved < NSVCD__NEVER);
    const int has_contact = result.has_contact && !(is_try && fraction > 0);
    if (is_open && has_contact) {
      open.has_contact = 1;
      open.found = result.found;
    }
    if (!is_open && !is_try && !is_resolved && !has_contact) {
      open = result;
      open.outcome = NSVCD__DONE;
      is_open = 1;
      fraction = 0;
    }
    if (has_contact || (is_open && !given->grows && p->work > goal.most)) break;
    nsvcd__next_interval(m, q, until, is_resolved || !is_try, p->work - before, &pace);
  }
  return is_open ? open : result;
}

// A component is inside the other body. That replaces any contact found since.
static nsvcd__finding nsvcd__found_inside(const nsvcd__solver *w,
                                          nsvcd__search_result *result) {
  memset(&result->found, 0, sizeof result->found);
  result->found.point = w->enclosed;
  result->found.moving_triangle = NSVCD_NO_TRIANGLE;
  result->found.fixed_triangle = NSVCD_NO_TRIANGLE;
  return NSVCD__FOUND_INSIDE;
}

// Do the bodies meet, and when? goal: of all of the motion. *result: what is known of it.
static nsvcd__finding nsvcd__prove(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal,
                                   nsvcd__search_result *result) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  const int in_order = goal.fraction > 0;
  const float gap = nsvcd__surface_gap(p, m, nsvcd__motion_gap(m));
  *result = p->known;
  if (gap > nsvcd__clearance(&goal)) return NSVCD__FOUND_FREE;
  const int is_long = nsvcd__is_long(m, q);
  if (NSVCD__KERNEL(w->isa, is_contained_at_start)(w)) {
    // It is a hit. A question that asks for more gets triangles, if some meet as well.
    const size_t units = NSVCD__INSIDE_BUDGET;
    const int meets = p->given.tells && nsvcd__meets_at(w, q, goal, 0, units, result);
    return meets ? NSVCD__FOUND_CONTACT : nsvcd__found_inside(w, result);
  }
  *result = is_long    ? nsvcd__search_intervals(w, q, goal)
            : in_order ? nsvcd__search_first(w, q, goal)
                       : nsvcd__search_whole(w, q, goal);
  const double clear = nsvcd__clear_until(w, result);
  if (result->outcome == NSVCD__ANSWERED) return NSVCD__FOUND_CONTACT;
  if (w->inside && clear > 0) return nsvcd__found_inside(w, result);
  if (result->has_contact) return NSVCD__FOUND_CONTACT;
  if (result->unresolved < NSVCD__NEVER) result->found = result->unresolved_pair;
  return clear < NSVCD__NEVER ? NSVCD__FOUND_UNDECIDED : NSVCD__FOUND_FREE;
}

// ---- the least distance

// Narrows the bracket interval by interval. A budget that was given is divided by time: each
// interval gets of what is left the share that it has of the rest of the motion.
static NSVCD__NOINLINE void nsvcd__narrow_intervals(nsvcd__solver *w, nsvcd__search *q,
                                                    nsvcd__goal goal, double finest,
                                                    nsvcd__bracket *bracket,
                                                    nsvcd__search_result *known) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  const size_t most = goal.most;
  const double known_low = bracket->low;
  size_t work = p->given.work;
  nsvcd__pace pace = {0, 1};
  double low = bracket->high;
  int is_wide = 0;
  while (m->from < m->ticks) {
    const uint32_t until = q->begin[q->segments];
    const size_t before = p->work;
    int is_resolved = 1;
    if (!p->given.grows) {
      const double rest = (double)(until - m->from) / (double)(m->ticks - m->from);
      work = before < most ? (size_t)(rest * (double)(most - before)) : 0;
    }
    goal.most = before + work;
    const float gap = nsvcd__interval_gap(m, m->from, until);
    bracket->low = nsvcd__max(known_low, (double)nsvcd__surface_gap(p, m, gap));
    bracket->is_wide = 0;
    const int is_narrow = nsvcd__has_pair(known) && bracket->high - bracket->low <= finest;
    if (bracket->low < bracket->high && !is_narrow) {
      if (m->arcs > 1) {
        goal.measure = finest;
        goal.limit = nsvcd__limit_after(p, &goal, NSVCD__TRY);
        is_resolved = nsvcd__measure_once(w, q, goal, bracket, known);
      } else {
        nsvcd__narrow(w, q, goal, work, finest, bracket, known);
      }
    }
    if (is_resolved) low = nsvcd__min(low, bracket->low);
    is_wide |= bracket->is_wide;
    nsvcd__next_interval(m, q, until, is_resolved, p->work - before, &pace);
  }
  bracket->low = nsvcd__min(low, bracket->high);
  bracket->is_wide = is_wide && bracket->high - bracket->low > finest;
}

// Brackets the least distance over the motion, once it is known whether the bodies come within the
// clearance.
static NSVCD__NOINLINE nsvcd__bracket nsvcd__measure(nsvcd__solver *w, nsvcd__search *q,
                                                     nsvcd__goal goal, nsvcd__finding verdict,
                                                     nsvcd__search_result *known) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  const double finest = p->given.width;
  int is_named = nsvcd__has_pair(known);
  const float gap = nsvcd__surface_gap(p, m, nsvcd__motion_gap(m));
  const double clear = verdict == NSVCD__FOUND_FREE ? p->given.clearance : 0;
  nsvcd__bracket bracket = {nsvcd__max(clear, (double)gap), known->found.distance, 0};
  const int is_long = nsvcd__is_long(m, q);
  if (is_long) nsvcd__choose_interval(m, q, 0, NSVCD__ALL_ARCS);
  if (!is_named) {
    bracket.high = NSVCD__KERNEL(w->isa, bound_distance)(w, q);
    is_named = known->has_contact = p->known.has_contact;
    known->found = p->known.found;
  }
  if (is_named && !(bracket.high - bracket.low > finest)) return bracket;
  if (is_long)
    nsvcd__narrow_intervals(w, q, goal, finest, &bracket, known);
  else
    nsvcd__narrow(w, q, goal, p->given.work, finest, &bracket, known);
  return bracket;
}
#endif  // NSVCD_NO_PROOF

// ------------------------------------------------------------------------------------- query/leave
// In: a question with a slop. Out: the question about a body pushed out of what it touches at the
// start.
//
// What carries a body must not stop it. Which contacts are those? The proof is about the body
// displaced by a vector v that has the slop's length along every normal that it touches at the
// start. That is a motion like any other, and what is proven of it is proven: the displaced body
// stays clear of everything, so the body itself goes no deeper than |v| into anything. There is no
// such v for what presses in deeper than the slop, or is held from opposite sides: that is hit as
// ever. v is constant as the fixed body sees it.

#ifndef NSVCD_NO_PROOF
// How good a push-out along a direction is.
typedef struct nsvcd__undoing {
  nsvcd__d3 n;
  // Twice how many touches it undoes. A touch counts once if the push-out goes against its faces:
  // what is beyond a face already, or is round and its middle is, would go further in.
  size_t count;
  size_t faces;     // touches with a face of about this normal
  double distance;  // how far it has to go
} nsvcd__undoing;

// Does a push-out along n go against all faces of a touch? A triangle without area has none.
static int nsvcd__is_against(nsvcd__d3 n, const nsvcd__touch *t) {
  int against = 0;
  for (size_t i = 0; i < 2; i++) {
    const int is_face = nsvcd__d3_dot(t->directions[i], t->directions[i]) > 0.5;
    if (is_face && nsvcd__d3_dot(n, t->directions[i]) > -0.3) return 0;
    against |= is_face;
  }
  return against;
}

// Takes a direction, unit, if it is better than the best so far: if it undoes more; of equals, if
// it goes less far; of those that go as far, if more faces have it.
static void nsvcd__try_push_out(const nsvcd__proof *p, nsvcd__d3 n, nsvcd__undoing *best) {
  const double same = nsvcd__epsilon(p) + 0.01 * nsvcd__max(best->distance, 0);
  nsvcd__undoing by = {n, 0, 0, -HUGE_VAL};
  if (best->count > 0 && nsvcd__d3_dot(n, best->n) > 0.99999) return;
  for (size_t k = 0; k < p->push.contact_count; k++) {
    const nsvcd__touch *t = &p->of.touches[k];
    const size_t left = 2 * (p->push.contact_count - k);
    if (by.count + left < best->count) return;
    if (by.count + left == best->count && by.distance > best->distance + same) return;
    if (!nsvcd__undoes(p, n, t)) continue;
    const double distance = nsvcd__depth_along(n, t);
    by.count += distance < 0 && !p->push.by_faces && nsvcd__is_against(n, t) ? 1u : 2u;
    by.faces +=
        nsvcd__d3_dot(n, t->directions[0]) > 0.9 || nsvcd__d3_dot(n, t->directions[1]) > 0.9;
    by.distance = p->push.by_faces ? 0 : nsvcd__max(by.distance, distance);
  }
  if (by.count == 0 || by.count < best->count) return;
  const int is_as_far = by.distance > best->distance - same;
  if (by.count == best->count && by.distance > best->distance + same) return;
  if (by.count == best->count && is_as_far && by.faces <= best->faces) return;
  *best = by;
}

// The best of the normals of all touches and of the directions across an edge of each. Its count is
// 0 if none undoes any touch.
static nsvcd__undoing nsvcd__best_push_out(const nsvcd__proof *p) {
  nsvcd__undoing best = {{0, 0, 0}, 0, 0, HUGE_VAL};
  for (size_t k = 0; k < p->push.contact_count; k++) {
    for (size_t i = 0; i < 3; i++)
      nsvcd__try_push_out(p, p->of.touches[k].directions[i], &best);
  }
  // an edge on an edge
  for (size_t k = 0; k < 9 * p->push.contact_count && best.distance > nsvcd__epsilon(p); k++) {
    const nsvcd__touch *t = &p->of.touches[k / 9];
    const nsvcd__d3 n = nsvcd__across_edges(t->moving, t->fixed, k % 9);
    const nsvcd__d3 out = nsvcd__d3_add(t->directions[0], t->directions[1]);
    const double side = nsvcd__d3_dot(n, out) < 0 ? -1 : 1;
    nsvcd__try_push_out(p, nsvcd__d3_scale(n, side), &best);
  }
  return best;
}

// Finds directions that undo all touches. Returns 0 if nothing undoes one, or it takes too many.
static int nsvcd__choose_push_outs(nsvcd__proof *p) {
  if (p->push.too_deep) return 0;
  while (p->push.contact_count > 0) {
    const size_t k = p->push.normal_count;
    if (k == NSVCD__PUSH_OUTS) return 0;
    const nsvcd__undoing best = nsvcd__best_push_out(p);
    if (best.count == 0) return 0;
    p->push.normals[k] = best.n;
    p->push.depths[k] = 0;
    p->push.normal_count++;
    size_t left = 0;
    for (size_t n = 0; n < p->push.contact_count; n++) {
      if (!nsvcd__undone_by(p, k, &p->of.touches[n])) p->of.touches[left++] = p->of.touches[n];
    }
    p->push.contact_count = left;
  }
  return 1;
}

// Nearly the shortest vector that has at least `least` along all known normals, plus, with
// by_depth, the depth along each: projections onto one half space after another (the relaxation
// method, Agmon 1954). 0 if there is none below four times the longest of these.
static nsvcd__d3 nsvcd__push_out(const nsvcd__push_outs *push, double least, int by_depth) {
  nsvcd__d3 push_out = {0, 0, 0};
  double longest = 0;
  for (size_t round = 0; round < 64; round++) {
    double most = 0;
    for (size_t k = 0; k < push->normal_count; k++) {
      const double along = least + (by_depth ? push->depths[k] : 0);
      const double lacks = along - nsvcd__d3_dot(push_out, push->normals[k]);
      longest = nsvcd__max(longest, along);
      most = nsvcd__max(most, lacks);
      if (lacks > 0)
        push_out = nsvcd__d3_add(push_out, nsvcd__d3_scale(push->normals[k], lacks));
    }
    if (nsvcd__d3_norm(push_out) > 4 * longest) break;
    if (most <= 0.005 * longest) return push_out;
  }
  return nsvcd__d3_of(0, 0, 0);
}

// Pushes a body at rest out of what it touches: by nothing at first, and by more as long as
// something touches. Triangles smaller than the slop can be separated along a wall that their
// neighbours still touch, and there may be too many touches to collect at once: so each push-out is
// tried. If the directions known have no push-out in common, the first one may be wrong, and is
// forgotten, once. Returns 0 if there is no push-out.
static int nsvcd__push_out_still(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *still = goal.motion;
  nsvcd__push_outs *push = &p->push;
  push->normal_count = 0;
  push->needed = 0;
  still->push_out = nsvcd__f3_of(0, 0, 0);
  // Also what is about to touch, or where an earlier motion may have ended, is pushed out of, and
  // may not touch afterwards.
  const double size = (double)p->given.lengths + p->given.radius;
  const double near_by = nsvcd__min(0.05 * push->slop, 0.02 * size);
  double beside = nsvcd__max(near_by, nsvcd__min(p->given.to, 0.5 * push->slop));
  for (int turns = 0;; beside = 0.01 * push->slop) {
    goal.clearance = p->given.clearance + beside + nsvcd__epsilon(p);
    (void)nsvcd__search_anew(w, q, goal);
    if (push->contact_count == 0) return 1;
    const size_t known = push->normal_count;
    if (!nsvcd__choose_push_outs(p) || push->normal_count == known) return 0;
    nsvcd__d3 push_out = nsvcd__push_out(push, push->slop, 0);
    if (!(nsvcd__d3_dot(push_out, push_out) > 0) && turns++ == 0) {
      memmove(push->normals, push->normals + 1, --push->normal_count * sizeof *push->normals);
      memmove(push->depths, push->depths + 1, push->normal_count * sizeof *push->depths);
      push_out = nsvcd__push_out(push, push->slop, 0);
    }
    if (!(nsvcd__d3_dot(push_out, push_out) > 0)) return 0;
    still->push_out = nsvcd__f3_round(push_out);
  }
}

// Makes the depths known as exact as need be. What is not in touch at the start may be where the
// body is pushed out to, and not all touches may have been collected. So the body is pushed out by
// little more than the known depths, to see what it touches there, until nothing does. Triangles
// that follow each other, as on a slope, each come free soon: so the little more doubles as long as
// depths grow.
static void nsvcd__deepen(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *still = goal.motion;
  const nsvcd__f3 push_out = still->push_out;
  const double least_more = 0.5 * nsvcd__epsilon(p);
  double more = least_more;
  double before = 0;
  goal.clearance = p->given.clearance;
  for (size_t k = 0; k < p->push.normal_count; k++) before += p->push.depths[k];
  for (int round = 0; round < NSVCD__DEEPEN; round++) {
    double after = 0;
    still->push_out = nsvcd__f3_round(nsvcd__push_out(&p->push, more, 1));
    (void)nsvcd__search_anew(w, q, goal);
    // A touch gets out of the way along the normal that undoes it first, even if no plane normal to
    // that separates it.
    for (size_t n = 0; n < p->push.contact_count; n++) {
      const nsvcd__touch *t = &p->of.touches[n];
      size_t best = 0;
      double least = HUGE_VAL;
      for (size_t k = 0; k < p->push.normal_count; k++) {
        const double distance = nsvcd__depth_along(p->push.normals[k], t);
        if (distance < least) best = k;
        least = nsvcd__min(least, distance);
      }
      nsvcd__note_depth(p, best, t);
    }
    for (size_t k = 0; k < p->push.normal_count; k++) after += p->push.depths[k];
    const int is_deeper = after > before;
    if (!is_deeper && more <= nsvcd__max(least_more, 0.002 * after)) break;
    more = is_deeper ? 2 * more : nsvcd__max(least_more, 0.125 * more);
    before = after;
  }
  still->push_out = push_out;
}

// Pushes the motion out of what it touches at its start, by the slop; or, if something is in the
// way of that and nothing is too deep, by what is needed.
static NSVCD__NOINLINE void nsvcd__push_out_motion(nsvcd__solver *w, nsvcd__search *q,
                                                   nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *whole = goal.motion;
  nsvcd__motion start = nsvcd__end_of(whole, 0);
  goal.motion = &start;
  goal.collects = NSVCD__TOUCHING;
  p->push.slop = p->given.slop;
  p->push.by_faces = 0;
  int is_free = nsvcd__push_out_still(w, q, goal);
  if (!is_free && !p->push.too_deep) {
    // The shortest push-outs may not go together.
    p->push.by_faces = 1;
    is_free = nsvcd__push_out_still(w, q, goal);
  }
  const double least = 1.1 * p->push.needed + 4 * nsvcd__epsilon(p);
  if (!is_free && p->push.contact_count == 0 && least < 0.9 * p->given.slop) {
    p->push.slop = least;
    is_free = nsvcd__push_out_still(w, q, goal);
  }
  if (is_free && p->push.normal_count > 0) nsvcd__deepen(w, q, goal);
  whole->push_out = is_free ? start.push_out : nsvcd__f3_of(0, 0, 0);
  nsvcd__restart(w, whole);
}
#endif  // NSVCD_NO_PROOF

// ----------------------------------------------------------------------------------- query/normals
// In: a contact, and the motion that led to it. Out: its normal.
//
// Just before two triangles meet, the direction between their nearest points still separates them:
// of all directions left at the contact, it is the one most against the motion. Where a corner
// comes to a face it is the face's normal, on the side that the corner comes from; where an edge
// crosses an edge, across both; where a corner comes to a corner, against the motion. A contact may
// be found a little after they have met: so one triangle is moved back, with the contact point's
// velocity, until they are separated. If they have touched from the start, the motion tells
// nothing: then it is the direction along which they are the least deep.
//
// Triangles within the clearance that do not meet have a direction: their nearest points'. It is
// along the motion only if they have been nearer, and then the contact is moved to before that.

#ifndef NSVCD_NO_PROOF
// The moving body's twist there, as the fixed body sees it.
static nsvcd__twist nsvcd__twist_at(const nsvcd__arc *arc, double u) {
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, u);
  const double per_tick = 1 / (double)arc->ticks;
  const nsvcd__dmat3 fixed = nsvcd__dmat3_of(nsvcd__slerp_at(&arc->fixed, u));
  nsvcd__d3 turn = nsvcd__slerp_turn(&arc->moving);
  nsvcd__d3 own = nsvcd__slerp_turn(&arc->fixed);
  turn = nsvcd__dmat3_apply_transpose(&fixed, turn);
  own = nsvcd__dmat3_apply_transpose(&fixed, own);
  // the moving body's pivot, as it moves; with what is added, the fixed body turns about its own
  const nsvcd__d3 arm = nsvcd__dmat3_apply(&at.rotation, arc->pivot);
  const nsvcd__d3 pivot = nsvcd__d3_fma(1 / arc->scale, arm, at.position);
  nsvcd__d3 along = nsvcd__dmat3_apply_transpose(&fixed, arc->moved);
  along = nsvcd__d3_add(along, nsvcd__d3_cross(own, arc->added));
  along = nsvcd__d3_sub(along, nsvcd__d3_cross(turn, pivot));
  nsvcd__twist out;
  out.along = nsvcd__d3_scale(along, per_tick);
  out.turn = nsvcd__d3_scale(nsvcd__d3_sub(turn, own), per_tick);
  return out;
}

// The arc of a time in ticks; at a keyframe, the arc that ends there: by that one the body came to
// the contact.
static const nsvcd__arc *nsvcd__arc_before(nsvcd__arcs *arcs, double tick, double *u) {
  uint32_t first = nsvcd__arc_of(arcs->motion, tick, u);
  if (first > 0 && tick - (double)first < 6e-8 * (double)arcs->motion->ticks) {
    first = nsvcd__arc_of(arcs->motion, (double)first - 0.5, u);
    *u = 1;
  }
  return nsvcd__arc_at(arcs, first);
}

// The triangles of a contact at a time, and how the bodies move then.
typedef struct nsvcd__approach {
  nsvcd__triangle_pair pair;
  nsvcd__touch contact;
  nsvcd__twist twist;
  double u;
} nsvcd__approach;

static NSVCD__NOINLINE void nsvcd__approach_at(nsvcd__proof *p,
                                               const nsvcd__pair_contact *found, double tick,
                                               nsvcd__approach *out) {
  const nsvcd__arc *arc = nsvcd__arc_before(&p->arcs, tick, &out->u);
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, out->u);
  out->pair = nsvcd__pair_of(p, found->moving_patch, found->fixed_patch, found->moving_entry,
                             found->fixed_entry);
  nsvcd__pose_triangle(&at, out->pair.moving, out->contact.moving);
  memcpy(out->contact.fixed, out->pair.fixed, sizeof out->contact.fixed);
  out->contact.directions[0] = nsvcd__d3_scale(nsvcd__face_direction(out->contact.moving), -1);
  out->contact.directions[1] = nsvcd__face_direction(out->contact.fixed);
  out->twist = nsvcd__twist_at(arc, out->u);
}

// Moves a contact to an earlier time, from `since` on, when its triangles were as near and did not
// come apart; if they meet, to when they began to. It stays if they touched at `since` and have
// come apart ever since.
static NSVCD__NOINLINE void nsvcd__move_back(nsvcd__proof *p, nsvcd__pair_contact *found,
                                             double since) {
  nsvcd__pair_contact sooner = *found;
  double early = since;
  double late = found->tick;
  double tick = late;
  for (size_t k = 0; k < NSVCD__HALVINGS && early < late; k++) {
    nsvcd__approach then;
    nsvcd__approach_at(p, found, tick, &then);
    const nsvcd__nearest nearest = nsvcd__nearest_of(then.contact.moving, then.contact.fixed);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    const nsvcd__d3 speed = nsvcd__twist_of(&then.twist, nearest.on_b);
    const double gap = sqrt(nearest.square);
    const int are_near = k == 0 || gap <= found->distance + then.pair.rounding;
    const int nearing = gap > then.pair.rounding && !(nsvcd__d3_dot(speed, apart) > 0);
    if (are_near && k > 0) sooner = nsvcd__contact_at(p, &then.pair, then.u, &nearest);
    if (are_near && nearing) break;
    *(are_near ? &late : &early) = tick;
    tick = k == 0 ? early : 0.5 * (early + late);
  }
  if (early < late) *found = sooner;
}

// The separating axes of two triangles that touch: two normals and nine products of edges, both
// ways. 0: edges are parallel.
enum { NSVCD__AXES = 22 };
static nsvcd__d3 nsvcd__axis_apart(const nsvcd__touch *t, size_t k) {
  const nsvcd__d3 n =
      k < 4 ? t->directions[1 - k / 2] : nsvcd__across_edges(t->moving, t->fixed, k / 2 - 2);
  return nsvcd__d3_scale(n, k % 2 ? -1 : 1);
}

// The normal at which two triangles met that touch, if the moving one came straight along `travel`,
// by `most` times that at most. 0: it did not. Nearer than the triangles are known, nothing tells
// which of them a corner met: so it is the normal a little before.
static NSVCD__NOINLINE int nsvcd__met_along(const nsvcd__proof *p, const nsvcd__approach *a,
                                            nsvcd__d3 travel, double most, nsvcd__d3 *normal) {
  const nsvcd__touch *t = &a->contact;
  const double close = 16 * nsvcd__epsilon(p) / nsvcd__d3_norm(travel);
  double back = HUGE_VAL;  // where they met, as a fraction of `travel`
  double before = 0;
  nsvcd__d3 moved[3];
  for (size_t k = 0; k < NSVCD__AXES; k++) {
    const nsvcd__d3 n = nsvcd__axis_apart(t, k);
    const double fall = -nsvcd__d3_dot(n, travel);
    const double deep = nsvcd__depth_along(n, t);
    if (!(fall > 0) || !(deep < back * fall)) continue;
    back = deep / fall;
    before = nsvcd__max(close, 1e4 * a->pair.rounding / fall);
    *normal = n;
  }
  if (!(back < most)) return 0;
  const nsvcd__d3 off = nsvcd__d3_scale(travel, back + before);
  for (int n = 0; n < 3; n++) moved[n] = nsvcd__d3_sub(t->moving[n], off);
  const nsvcd__nearest nearest = nsvcd__nearest_of(moved, t->fixed);
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
  if (nsvcd__d3_dot(apart, travel) < 0) *normal = nsvcd__d3_unit(apart, *normal);
  return 1;
}

// The direction along which two triangles that touch are the least deep in each other; of several
// the one most against `travel`. A face of a closed surface has one side, and the direction is not
// against both faces.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__shallowest(const nsvcd__proof *p,
                                                   const nsvcd__approach *a,
                                                   nsvcd__d3 travel) {
  const int moving_closed = nsvcd__moving_closed(p, &a->pair);
  const int fixed_closed = nsvcd__fixed_closed(p, &a->pair);
  const nsvcd__touch *t = &a->contact;
  const double same = 1e4 * a->pair.rounding;
  nsvcd__d3 best = t->directions[1];
  double least = HUGE_VAL;
  for (size_t k = 0; k < NSVCD__AXES; k++) {
    const nsvcd__d3 n = nsvcd__axis_apart(t, k);
    const int out_of_a = !moving_closed || nsvcd__d3_dot(n, t->directions[0]) >= -1e-9;
    const int out_of_b = !fixed_closed || nsvcd__d3_dot(n, t->directions[1]) >= -1e-9;
    int is_out = out_of_a || out_of_b;
    if (k < 4) is_out = k < 2 ? out_of_b : out_of_a;
    if (!is_out || !(nsvcd__d3_dot(n, n) > 0.5)) continue;
    const double depth = nsvcd__depth_along(n, t);
    const double more = nsvcd__d3_dot(nsvcd__d3_sub(best, n), travel);
    if (depth > least - same && !(depth < least + same && more > 0)) continue;
    best = n;
    least = nsvcd__min(least, depth);
  }
  return best;
}

// The normal at which the triangles of the known contact met, if that was after `since`, or, if
// they were free of each other then, at any time. 0: it was not.
static int nsvcd__normal_met(nsvcd__proof *p, nsvcd__pair_contact *found, double since,
                             int is_free, nsvcd__approach *now) {
  nsvcd__approach_at(p, found, found->tick, now);
  const nsvcd__d3 speed = nsvcd__twist_of(&now->twist, found->point);
  const nsvcd__d3 travel = nsvcd__d3_scale(speed, found->tick - since);
  return nsvcd__met_along(p, now, travel, is_free ? HUGE_VAL : 1, &found->normal);
}

// Are two times, in ticks, in different arcs?
static int nsvcd__has_turned(const nsvcd__proof *p, double since, double until) {
  double u;
  const uint32_t first = nsvcd__arc_of(p->arcs.motion, since, &u);
  return first != nsvcd__arc_of(p->arcs.motion, until, &u);
}

// Gives the known contact its normal.
static NSVCD__NOINLINE void nsvcd__resolve_normal(nsvcd__proof *p, double clear_until,
                                                  nsvcd__search_result *result) {
  nsvcd__pair_contact *found = &result->found;
  const double until = nsvcd__max(nsvcd__min(clear_until, found->tick), 0);
  const double since = p->given.fraction > 0 ? until : 0;
  const int is_free = since > 0 || (p->given.fraction > 0 && result->starts_free);
  nsvcd__approach now;
  // What comes to a pose and goes back may have been found on its way back.
  const int has_turned = is_free && nsvcd__has_turned(p, since, found->tick);
  if (found->distance > 0 || has_turned) nsvcd__move_back(p, found, since);
  if (found->distance > 0) return;
  if (has_turned && nsvcd__has_turned(p, since, found->tick)) {
    // These met on the way back alone, but others did on the way there.
    nsvcd__approach_at(p, found, since, &now);
    const nsvcd__nearest nearest = nsvcd__nearest_of(now.contact.moving, now.contact.fixed);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    found->normal = nsvcd__d3_unit(apart, found->normal);
    return;
  }
  if (nsvcd__normal_met(p, found, since, 0, &now)) return;
  if (is_free) {
    // The motion has turned since, and they may come apart again.
    nsvcd__move_back(p, found, since);
    if (nsvcd__normal_met(p, found, since, 1, &now)) return;
  }
  const nsvcd__d3 speed = nsvcd__twist_of(&now.twist, found->point);
  found->normal = nsvcd__shallowest(p, &now, speed);
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------------- query/supports
// In: the farthest contact points along directions. Out: the directions, and the best four points.

#ifndef NSVCD_NO_PROOF
// Prepares a manifold of contacts with about this normal, unit, of bodies that move like this.
static void nsvcd__manifold_begin(nsvcd__manifold *m, nsvcd__d3 n, const nsvcd__twist *twist,
                                  double tolerance, double same) {
  const int flattest = fabs(n.x) < fabs(n.y) ? 0 : 1;
  const nsvcd__d3 aside = nsvcd__d3_of(flattest == 0, flattest == 1, 0);
  const nsvcd__d3 u = nsvcd__d3_unit(nsvcd__d3_cross(n, aside), nsvcd__d3_of(1, 0, 0));
  memset(m, 0, sizeof *m);
  m->normal = n;
  m->twist = *twist;
  m->tolerance = tolerance;
  m->same = same;
  // An eighth of a turn each: the sum of a direction and of that a quarter on, made unit.
  nsvcd__d3 along = u;
  for (int k = 0; k < NSVCD__AROUND; k++) {
    m->along[k] = along;
    m->farthest[k] = -HUGE_VAL;
    along = nsvcd__d3_scale(nsvcd__d3_add(along, nsvcd__d3_cross(n, along)), sqrt(0.5));
  }
  for (int k = NSVCD__AROUND; k < NSVCD__SUPPORTS; k++) m->farthest[k] = HUGE_VAL;
}

// If what has been found spans little for its length, prepares the two directions across it, for
// what is between the eight. area: twice what is spanned. Returns 0 if it is not so slim.
static int nsvcd__seek_across(nsvcd__manifold *m, double area) {
  nsvcd__d3 longest = {0, 0, 0};
  for (int k = 0; k < NSVCD__AROUND; k++) {
    for (int n = 0; n < k && m->farthest[k] > -HUGE_VAL && m->farthest[n] > -HUGE_VAL; n++) {
      const nsvcd__d3 offset = nsvcd__d3_sub(m->supports[k].point, m->supports[n].point);
      if (nsvcd__d3_dot(offset, offset) > nsvcd__d3_dot(longest, longest)) longest = offset;
    }
  }
  const double square = nsvcd__d3_dot(longest, longest);
  if (!(square > m->same * m->same) || area > NSVCD__SLIM * square) return 0;
  const nsvcd__d3 across = nsvcd__d3_unit(nsvcd__d3_cross(m->normal, longest), m->along[0]);
  for (int k = NSVCD__AROUND; k < NSVCD__SUPPORTS; k++) {
    m->along[k] = nsvcd__d3_scale(across, k == NSVCD__AROUND ? 1 : -1);
    m->farthest[k] = -HUGE_VAL;
    for (int n = 0; n < NSVCD__AROUND; n++) {
      const double along_it = nsvcd__d3_dot(m->along[k], m->supports[n].point);
      if (!(m->farthest[n] > -HUGE_VAL) || !(along_it > m->farthest[k])) continue;
      m->farthest[k] = along_it;
      m->supports[k] = m->supports[n];
      m->numbers[k] = m->numbers[n];
    }
  }
  return 1;
}

// Twice the area that four points span, seen along the normal.
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

// Chooses the contacts: which supports, and twice the area that they span. Returns how many.
static NSVCD__NOINLINE int nsvcd__choose_four(const nsvcd__manifold *m, int *chosen,
                                              double *area) {
  int kept[NSVCD__SUPPORTS];
  int count = 0;
  // Each point once, in the order of their numbers.
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
  for (uint32_t all = 0; all < 1u << count; all++) {
    int four[4];
    int size = 0;
    if (nsvcd__bit_count(all) != 4) continue;
    for (uint32_t left = all; left; left &= left - 1)
      four[size++] = kept[nsvcd__low_bit(left)];
    const double spanned = nsvcd__spanned(m, four);
    if (!(spanned > 1.001 * *area)) continue;
    *area = spanned;
    memcpy(chosen, four, 4 * sizeof *chosen);
  }
  return 4;
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------------- query/by_proof
// In: a task. Out: its answer, by proof, with contacts as points in the world.

#ifndef NSVCD_NO_PROOF
// A body's pose at time t in [0,1], in the world.
static nsvcd__dpose nsvcd__dpose_at(const nsvcd__motion *motion, const nsvcd__track *track,
                                    double t) {
  const double tick = t * (double)motion->ticks;
  const uint32_t k = nsvcd__pose_before(track, (uint32_t)tick);
  const uint32_t from = nsvcd__tick_of(track, k);
  const uint32_t length = nsvcd__tick_of(track, k + 1) - from;
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = track->count > 1 ? a + 1 : a;
  const double fraction = (tick - (double)from) / (double)length;
  return nsvcd__dpose_between(a, b, nsvcd__track_pivot(track), fraction);
}

// From the fixed body's frame, in metres, to the world, at time t.
static nsvcd__dtransform nsvcd__world_at(const nsvcd__motion *motion, double t) {
  const nsvcd__dpose pose = nsvcd__dpose_at(motion, &motion->fixed, t);
  return nsvcd__dtransform_of(&pose);
}

// The length to which an answer is asked for, or the default, in the fixed body's units.
static double nsvcd__to_of(const nsvcd__task *task) {
  const nsvcd_question *q = task->question;
  const float moving = task->motion.scale * nsvcd__whole_radius(task->moving);
  const float fixed = nsvcd__whole_radius(task->fixed);
  const float usual = NSVCD_DEFAULT_TO * (moving < fixed ? moving : fixed);
  return q->to > 0 ? (double)q->to / (double)task->motion.unit : (double)usual;
}

// How far points of the moving body travel in an arc, at most.
static double nsvcd__travel_in(const nsvcd__proof *p, const nsvcd__arc *arc) {
  return arc->speed + arc->turn * arc->scale * (double)p->moving.body->extent;
}

// The fraction of the motion in which no point of the moving body travels farther than `to`, at
// most `fraction`; 0: that is not asked for. Of a short motion it is at most a quarter, so that a
// contact does not cost all of it, but no less than a safe pose backs off.
static double nsvcd__fraction_of(nsvcd__proof *p, double to, double fraction) {
  const nsvcd__motion *motion = p->arcs.motion;
  const double most = fraction > 0 ? fraction : 1;
  double fastest = 0;  // per tick
  for (uint32_t first = 0; to > 0 && first < motion->ticks;) {
    const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, first);
    fastest = fmax(fastest, nsvcd__travel_in(p, arc) / (double)arc->ticks);
    first += arc->ticks;
  }
  const double whole = fastest * (double)motion->ticks;
  const double least = fmin(to, fmax(0.25 * whole, NSVCD__EPSILONS * nsvcd__epsilon(p)));
  return least < most * whole ? least / whole : most;
}

// Prepares the proof for a question whose motion has been prepared. Returns what is asked of all of
// the motion.
static nsvcd__goal nsvcd__proof_begin(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd_question *q = task->question;
  const double unit = (double)task->motion.unit;
  nsvcd__solver *w = query->solver;
  nsvcd__given *given = &w->p.given;
  nsvcd__goal goal;
  memset(given, 0, sizeof *given);
  memset(&goal, 0, sizeof goal);
  w->isa = query->isa;
  w->intervals = query->intervals;
  goal.motion = &query->task.motion;
  nsvcd__restart(w, goal.motion);
  w->p.moving = nsvcd__geometry_of(nsvcd__triangles_of(task->moving));
  w->p.fixed = nsvcd__geometry_of(nsvcd__triangles_of(task->fixed));
  given->lengths = task->motion.scale * w->p.moving.body->extent + w->p.fixed.body->extent;
  given->lengths += nsvcd__pivot_arms(&task->motion);
  given->tolerance = (double)q->tolerance / unit;
  const double moving_radius = (double)w->p.moving.counts->convex_radius * task->motion.ratio;
  given->radius = moving_radius + (double)w->p.fixed.counts->convex_radius;
  given->clearance = (double)q->clearance / unit + given->radius;
  goal.clearance = given->clearance;
  given->slop = (double)q->slop / unit;
  const int is_verdict = q->ask != NSVCD_ASK_DISTANCE;
  const size_t most = is_verdict ? NSVCD_DEFAULT_VERDICT_WORK : NSVCD_DEFAULT_WORK;
  given->work = goal.limit = goal.most = q->work ? q->work : most;
  given->reserve = (q->work ? q->work : NSVCD_DEFAULT_WORK) / NSVCD__AFTER_UNRESOLVED;
  given->grows = q->work == 0;
  given->tells = q->ask != NSVCD_ASK_HIT || given->slop > 0;
  w->p.work = w->p.push.normal_count = 0;
  w->inside = w->in_open = 0;
  w->unclear = NSVCD__CLEAR;
  const double to = nsvcd__to_of(task);
  if (q->ask == NSVCD_ASK_DISTANCE) given->width = to;
  if (q->ask == NSVCD_ASK_FIRST) {
    const int by_time = q->to_time > 0 && !(q->to > 0);
    given->to = q->to > 0 ? to : 0;
    given->fraction = nsvcd__fraction_of(&w->p, by_time ? 0 : to, (double)q->to_time);
  }
  goal.end = NSVCD__NEVER;
  goal.high = HUGE_VAL;
  goal.fraction = given->fraction;
  goal.after_unresolved = goal.fraction > 0 ? NSVCD__AFTER_FIRST_UNRESOLVED : given->reserve;
  w->p.goal = goal;
  return goal;
}

// Writes the contact that a proof has found: when, where, and of what. If the bodies were swapped,
// the fixed one counts as pushed out, in the opposite direction.
static NSVCD__NOINLINE void nsvcd__write_contact(const nsvcd__query *query,
                                                 const nsvcd__pair_contact *found,
                                                 nsvcd_contact *out) {
  const nsvcd__proof *p = &query->solver->p;
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *motion = &task->motion;
  const int rests = motion->moving.count == 1 && !motion->fixed_moves;
  const double time = rests ? 0 : found->tick / (double)motion->ticks;
  const double unit = (double)motion->unit;
  const nsvcd__dtransform world = nsvcd__world_at(motion, time);
  const nsvcd__d3 push_out = nsvcd__d3_scale(nsvcd__d3_widen(motion->push_out), task->swapped);
  const double beyond = fmin((double)p->fixed.counts->convex_radius, found->distance);
  const nsvcd__d3 on = nsvcd__d3_fma(beyond, found->normal, found->point);
  const nsvcd__d3 seen = nsvcd__d3_scale(nsvcd__d3_sub(on, push_out), unit);
  const nsvcd__d3 point = nsvcd__d3_transform(&world, seen);
  const nsvcd__d3 normal = nsvcd__dmat3_apply(&world.rotation, found->normal);
  nsvcd__f3_store(nsvcd__f3_round(point), out->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), out->normal);
  out->gap = (float)(fmax(found->distance - p->given.radius, 0) * unit);
  // Rounded up: by then they have met.
  out->time = (float)time;
  if ((double)out->time < time) out->time = nextafterf(out->time, 1);
  out->triangle_a = found->moving_triangle;
  out->triangle_b = found->fixed_triangle;
  out->patch_a = found->moving_patch;
  out->patch_b = found->fixed_patch;
}

// The moving body takes the push-out; if both or none move, a does.
static int nsvcd__takes_push_out(const nsvcd__task *task) {
  return !task->swapped || !(task->motion.fixed_moves || task->motion.moving.count == 1);
}

// The poses of both bodies at time t, with one of them displaced by a push-out, which is in the
// fixed body's frame and units.
static NSVCD__NOINLINE void nsvcd__poses_at(const nsvcd__task *task, double t,
                                            nsvcd__d3 push_out, nsvcd_pose *moving,
                                            nsvcd_pose *fixed) {
  const nsvcd__motion *motion = &task->motion;
  const double unit = (double)motion->unit;
  const int moving_takes_it = nsvcd__takes_push_out(task);
  const nsvcd__dtransform world = nsvcd__world_at(motion, t);
  const nsvcd__d3 seen = nsvcd__dmat3_apply(&world.rotation, push_out);
  for (int n = 0; n < 2; n++) {
    const double by = n == moving_takes_it ? 0 : n ? -unit : unit;
    nsvcd__dpose pose = nsvcd__dpose_at(motion, n ? &motion->fixed : &motion->moving, t);
    pose.position = nsvcd__d3_add(pose.position, nsvcd__d3_scale(seen, by));
    *(n ? fixed : moving) = nsvcd__dpose_round(&pose);
  }
}

// How far the poses of an answer, in float, are off at time t, at most, in the fixed body's units:
// positions and quaternions are off by 6e-8 of their length.
static double nsvcd__pose_error(const nsvcd__proof *p, double t) {
  const nsvcd__motion *motion = p->arcs.motion;
  const nsvcd__d3 moving = nsvcd__dpose_at(motion, &motion->moving, t).position;
  const nsvcd__d3 fixed = nsvcd__dpose_at(motion, &motion->fixed, t).position;
  const double positions = nsvcd__d3_norm(moving) + nsvcd__d3_norm(fixed);
  return 1.3e-7 * (2 * positions / (double)motion->unit + (double)p->given.lengths);
}

// Sets the bodies down at time t, at which they are free of each other when pushed out as the
// motion is: to a little more than their depth at the start, or to a little before they are in
// contact. Returns the push-out left. It is proven to be free, and so is the way down to it.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__set_down(nsvcd__query *query, nsvcd__goal goal,
                                                 double t) {
  nsvcd__solver *w = query->solver;
  const nsvcd__task *task = &query->task;
  nsvcd__motion *whole = goal.motion;
  nsvcd__motion down = *whole;
  nsvcd_pose moving[2], fixed[2];
  const int takes_it = nsvcd__takes_push_out(task);
  const nsvcd__track moves = {moving, NULL, takes_it ? 2u : 1u, 0, 0, 1, NULL};
  const nsvcd__track rests = {fixed, NULL, takes_it ? 1u : 2u, 0, 0, 1, NULL};
  const nsvcd__d3 push_out = nsvcd__d3_widen(whole->push_out);
  // Nearer to each other than stored triangles are known, nothing would be separated.
  const double epsilons = 4 * nsvcd__epsilon(&w->p) + nsvcd__pose_error(&w->p, t);
  const double kept = fmax(NSVCD__SET_DOWN * w->p.push.slop, epsilons);
  const nsvcd__d3 least = nsvcd__push_out(&w->p.push, kept, 1);
  const nsvcd__d3 by = nsvcd__d3_sub(push_out, least);
  const double length = nsvcd__d3_norm(by);
  if (!(nsvcd__d3_dot(by, push_out) > 0) || !(length > kept)) return push_out;
  nsvcd__poses_at(task, t, push_out, &moving[0], &fixed[0]);
  nsvcd__poses_at(task, t, least, &moving[1], &fixed[1]);
  nsvcd__motion_set_tracks(&down, moves, rests);
  down.push_out = nsvcd__f3_of(0, 0, 0);
  goal.motion = &down;
  goal.fraction = kept / length;
  goal.limit = w->p.work + w->p.given.reserve;
  const nsvcd__search_result result = nsvcd__search_anew(w, &query->broad_phase, goal);
  nsvcd__arcs_begin(&w->p.arcs, whole);
  const double until = nsvcd__clear_until(w, &result) / (double)down.ticks;
  // All before an unresolved pair is proven, but a query from close to it might not prove it again.
  const double clear = result.unresolved < result.end ? until - 0.5 * goal.fraction : until;
  return nsvcd__d3_sub(push_out, nsvcd__d3_scale(by, fmin(fmax(clear, 0), 1)));
}

// The bodies at rest as they are at time t, with the fixed one's origin in the world's: so points
// in its frame are as exact as they can be.
static nsvcd__motion nsvcd__rest_at(const nsvcd__task *task, double t, nsvcd_pose *poses) {
  nsvcd__motion still = task->motion;
  const nsvcd__track tracks[2] = {{&poses[0], NULL, 1, 0, 0, 1, NULL},
                                  {&poses[1], NULL, 1, 0, 0, 1, NULL}};
  nsvcd__dpose moving = nsvcd__dpose_at(&still, &still.moving, t);
  nsvcd__dpose fixed = nsvcd__dpose_at(&still, &still.fixed, t);
  const nsvcd__dmat3 rotation = nsvcd__dtransform_of(&fixed).rotation;
  const nsvcd__d3 push_out = nsvcd__dmat3_apply(&rotation, nsvcd__d3_widen(still.push_out));
  const nsvcd__d3 offset = nsvcd__d3_sub(moving.position, fixed.position);
  moving.position = nsvcd__d3_add(offset, nsvcd__d3_scale(push_out, (double)still.unit));
  fixed.position = nsvcd__d3_of(0, 0, 0);
  poses[0] = nsvcd__dpose_round(&moving);
  poses[1] = nsvcd__dpose_round(&fixed);
  nsvcd__motion_set_tracks(&still, tracks[0], tracks[1]);
  still.push_out = nsvcd__f3_of(0, 0, 0);
  return still;
}

// The normals that a manifold may have: that of the contact found, and those of its faces that are
// not against it and along which the bodies do not part. Returns how many. *twist: how the bodies
// move; 0 at the start, where they only touch.
static NSVCD__NOINLINE int nsvcd__manifold_normals(nsvcd__proof *p,
                                                   const nsvcd__pair_contact *found,
                                                   nsvcd__twist *twist, nsvcd__d3 *normals) {
  nsvcd__approach now;
  int count = 1;
  nsvcd__approach_at(p, found, found->tick, &now);
  memset(twist, 0, sizeof *twist);
  if (found->tick > 0) *twist = now.twist;
  normals[0] = found->normal;
  const nsvcd__facing f = nsvcd__facing_of(p, found->normal, &now.pair, now.contact.moving);
  for (int k = 1; k >= 0; k--) {
    const nsvcd__d3 n = f.faces[k];
    const nsvcd__d3 all[2] = {found->normal, found->normal};
    int is_new = nsvcd__d3_dot(n, found->normal) > -0.1;
    is_new &= !nsvcd__is_left(twist, found->point, n, all);
    for (int i = 0; i < count; i++) is_new &= nsvcd__d3_dot(n, normals[i]) <= 0.9;
    if (is_new) normals[count++] = n;
  }
  return count;
}

// Writes the manifold of the contact found. If a body stands on something, that contact may be with
// a side that rises from it: so the normals of both triangles are tried too, and the manifold that
// spans the most is taken.
static NSVCD__NOINLINE void nsvcd__write_manifold(nsvcd__query *query, nsvcd__goal goal,
                                                  const nsvcd__pair_contact *found,
                                                  nsvcd_answer *answer) {
  nsvcd__solver *w = query->solver;
  const nsvcd__task *task = &query->task;
  const double epsilon = nsvcd__epsilon(&w->p);
  const double same = epsilon + 1e-5 * (double)w->p.given.lengths;
  const float radius = task->motion.scale * task->moving->radius;
  const double extent = (double)fminf(radius, task->fixed->radius);
  nsvcd__manifold *m = &w->p.of.kept.manifold;
  nsvcd__d3 normals[3];
  double widest = -1;
  nsvcd_pose poses[2];
  nsvcd__twist twist;
  int tries = nsvcd__manifold_normals(&w->p, found, &twist, normals);
  nsvcd__motion still = nsvcd__rest_at(task, (double)answer->nearest.time, poses);
  nsvcd__motion *whole = goal.motion;
  goal.motion = &still;
  goal.collects = NSVCD__SUPPORTING;
  goal.clearance = w->p.given.clearance + fmax(nsvcd__to_of(task), 4 * epsilon);
  goal.limit = w->p.work + w->p.given.reserve;
  (void)nsvcd__search_anew(w, &query->broad_phase, goal);
  for (int k = 0; k < tries; k++) {
    int chosen[NSVCD_MAX_CONTACTS];
    double area;
    nsvcd__manifold_begin(m, normals[k], &twist, goal.clearance, same);
    NSVCD__KERNEL(w->isa, seek_positions)(w, 0, NSVCD__AROUND);
    int count = nsvcd__choose_four(m, chosen, &area);
    if (nsvcd__seek_across(m, area)) {
      NSVCD__KERNEL(w->isa, seek_positions)(w, NSVCD__AROUND, NSVCD__SUPPORTS);
      count = nsvcd__choose_four(m, chosen, &area);
    }
    if (count == 0 || !(area > 1.001 * widest)) continue;
    widest = area;
    if (count > 2 && area > 0.1 * extent * extent) tries = 1;
    answer->contact_count = (size_t)count;
    for (int n = 0; n < count; n++) {
      nsvcd__pair_contact support = m->supports[chosen[n]];
      support.tick = found->tick;
      nsvcd__write_contact(query, &support, &answer->contacts[n]);
      // The last bit tells which body a corner is of.
      answer->contacts[n].id = m->numbers[chosen[n]] ^ (uint32_t)task->swapped;
    }
  }
  nsvcd__arcs_begin(&w->p.arcs, whole);
}

// Writes where the bodies may go, which are proven free until answer->time.low, and how deep they
// are in contact at the start. If one may be inside the other, no push-out helps, and they stay.
static NSVCD__NOINLINE void nsvcd__write_safe_pose(nsvcd__query *query, nsvcd__goal goal,
                                                   int starts_free, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const nsvcd__solver *w = query->solver;
  const double t = (double)answer->safe.time;
  nsvcd__d3 push_out = nsvcd__d3_widen(task->motion.push_out);
  const int is_pushed = nsvcd__d3_dot(push_out, push_out) > 0;
  const int may_go = is_pushed && !w->inside && !w->unclear;
  if (is_pushed && !w->inside) {
    const double depth = nsvcd__d3_norm(nsvcd__push_out(&w->p.push, 0, 1));
    answer->depth = (float)(depth * (double)task->motion.unit);
  } else if (!is_pushed && (answer->time.low > 0 || starts_free)) {
    answer->depth = 0;
  }
  if (may_go) push_out = nsvcd__set_down(query, goal, t);
  // nsvcd__answer_begin has set the poses at the ends, as the caller has them.
  if (may_go || (t > 0 && t < 1))
    nsvcd__poses_at(task, t, push_out, &answer->safe.a, &answer->safe.b);
}

// Writes until when the motion is proven free, and up to which time the bodies may go.
static void nsvcd__write_time(nsvcd__proof *p, double clear_until, nsvcd_answer *answer) {
  const nsvcd__motion *motion = p->arcs.motion;
  const double ticks = (double)motion->ticks;
  const double until = fmin(fmax(clear_until / ticks, 0), 1);
  const double late = (double)answer->time.high - until;
  answer->time.low = (float)(until * (1 - 1e-7));
  if (late > p->given.fraction * 1.0001 + 1e-6) answer->why = NSVCD_WHY_WORK;
  // Closer poses are proven free here, but a new query from there could not prove it again.
  double u;
  const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, nsvcd__arc_of(motion, until * ticks, &u));
  const double length = nsvcd__travel_in(p, arc) * ticks / (double)arc->ticks;
  const double epsilons = NSVCD__EPSILONS * nsvcd__epsilon(p) + nsvcd__pose_error(p, until);
  const double back = length > epsilons ? epsilons / length : p->given.fraction;
  answer->safe.time = (float)(fmax(0, until - back) * (1 - 1e-7));
}

// Writes the bracket of the least distance.
static void nsvcd__write_distance(const nsvcd__proof *p, nsvcd_verdict verdict,
                                  const nsvcd__bracket *bracket,
                                  const nsvcd__search_result *named, nsvcd_answer *answer) {
  const double unit = (double)p->arcs.motion->unit;
  const double radius = p->given.radius;
  const double off = nsvcd__off_meshes(p) + 1e-12 * (double)p->given.lengths;
  double low = bracket->low;
  double high = bracket->high;
  if (verdict == NSVCD_FREE) low = fmax(p->given.clearance, low);
  if (named) high = fmax(named->found.distance, radius) + off;
  answer->distance.low = (float)(fmax(low - radius, 0) * unit * (1 - 1e-6));
  answer->distance.high = (float)(fmax(high - radius, 0) * unit * (1 + 1e-6));
}

// Why not all is answered; `why` unless there is a better reason. Neither work nor finer triangles
// would tell what is in an open solid.
static nsvcd_why nsvcd__why_of(const nsvcd__solver *w, nsvcd_why why, int is_wide,
                               nsvcd_verdict verdict, const nsvcd__search_result *result) {
  const int is_too_near =
      result->unresolved < NSVCD__NEVER || w->unclear == NSVCD__CANNOT_TELL;
  if (is_wide || verdict == NSVCD_UNDECIDED) why = NSVCD_WHY_WORK;
  if (why && w->in_open) return NSVCD_WHY_OPEN;
  return why && !is_wide && is_too_near ? NSVCD_WHY_TOO_NEAR : why;
}

// Writes the push-out in the world, at the start.
static void nsvcd__write_push_out(const nsvcd__motion *motion, nsvcd_answer *answer) {
  const nsvcd__d3 push_out = nsvcd__d3_widen(motion->push_out);
  if (!(nsvcd__d3_dot(push_out, push_out) > 0)) return;
  const nsvcd__dtransform world = nsvcd__world_at(motion, 0);
  const nsvcd__d3 turned = nsvcd__dmat3_apply(&world.rotation, push_out);
  const nsvcd__d3 metres = nsvcd__d3_scale(turned, (double)motion->unit);
  nsvcd__f3_store(nsvcd__f3_round(metres), answer->push_out);
}

// Answers a question whose motion has been prepared.
static void nsvcd__answer_by_proof(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__solver *w = query->solver;
  const nsvcd__goal goal = nsvcd__proof_begin(query);
  const nsvcd__given *given = &w->p.given;
  nsvcd__bracket bracket = {0, HUGE_VAL, 0};
  nsvcd__search_result result;
  if (given->slop > 0) nsvcd__push_out_motion(w, search, goal);
  nsvcd__finding finding = nsvcd__prove(w, search, goal, &result);
  if (given->width > 0 && finding != NSVCD__FOUND_INSIDE) {
    bracket = nsvcd__measure(w, search, goal, finding, &result);
    // A distance decides what was left undecided, but says nothing of containment.
    const int meets = result.has_contact && result.found.distance <= given->clearance;
    const int is_beyond = bracket.low > 0 && bracket.low >= given->clearance;
    const int is_clear = is_beyond && !w->unclear && !w->inside;
    if (finding == NSVCD__FOUND_UNDECIDED && (meets || is_clear))
      finding = meets ? NSVCD__FOUND_CONTACT : NSVCD__FOUND_FREE;
  }

  const double until = nsvcd__clear_until(w, &result);

  // The answer names the triangles of a contact, or else of an unresolved pair.
  const int is_inside = finding == NSVCD__FOUND_INSIDE;
  const int is_contact = finding == NSVCD__FOUND_CONTACT;
  const int is_unresolved =
      finding == NSVCD__FOUND_UNDECIDED && result.unresolved < NSVCD__NEVER;
  const int names = (result.has_contact || is_unresolved) && !is_inside;
  const nsvcd_verdict verdict = finding == NSVCD__FOUND_FREE ? NSVCD_FREE
                                : is_inside || is_contact    ? NSVCD_HIT
                                                             : NSVCD_UNDECIDED;
  if (names) nsvcd__resolve_normal(&w->p, until, &result);
  nsvcd__answer_begin(task, verdict, answer);
  answer->inside = is_inside;
  if (names || is_inside) nsvcd__write_contact(query, &result.found, &answer->nearest);
  if (is_inside) answer->nearest.gap = HUGE_VALF;
  if (verdict == NSVCD_HIT) answer->time.high = answer->nearest.time;
  if (is_contact) answer->contacts[answer->contact_count++] = answer->nearest;
  if (given->fraction > 0 && verdict != NSVCD_FREE && !is_inside)
    nsvcd__write_time(&w->p, until, answer);
  nsvcd__write_distance(&w->p, verdict, &bracket, names ? &result : NULL, answer);
  if (is_inside) answer->distance.high = 0;
  // A contact, found or moved to where it is nearer, may have made the bracket narrow enough.
  const double high = names ? result.found.distance : bracket.high;
  const int is_wide = bracket.is_wide && high - bracket.low > given->width;
  answer->why = nsvcd__why_of(w, answer->why, is_wide, verdict, &result);
  nsvcd__write_push_out(&task->motion, answer);
  if (task->question->manifold && is_contact)
    nsvcd__write_manifold(query, goal, &result.found, answer);
  nsvcd__write_safe_pose(query, goal, result.starts_free, answer);
  answer->work = w->p.work;
}
#endif  // NSVCD_NO_PROOF

// ---------------------------------------------------------------------------------- query/question
// In: questions and a workspace. Out: answers, or why not. The public functions of queries.

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
  return NSVCD_METHOD_DEFAULT;
}

// Is a question in order?
static nsvcd_result nsvcd__question_check(const nsvcd_question *q) {
  const nsvcd_mover *a = &q->a;
  const nsvcd_mover *b = &q->b;
  nsvcd_result result = nsvcd__mover_check(a);
  if (!result) result = nsvcd__mover_check(b);
  if (result) return result;
  // The same body in the same motion: something was passed twice.
  const float scale_a = nsvcd__scale_of(a);
  const float scale_b = nsvcd__scale_of(b);
  const int same_size = !(scale_a < scale_b) && !(scale_b < scale_a);
  const int same_motion = a->poses == b->poses && a->times == b->times && a->count == b->count;
  if (a->body == b->body && same_motion && same_size) return NSVCD_ERROR_SAME;

  // Are the options' numbers in their ranges, and do they go together?
  if ((unsigned)q->method > (unsigned)NSVCD_METHOD_NETWORK) return NSVCD_ERROR_METHOD;
  if ((unsigned)q->ask > (unsigned)NSVCD_ASK_DISTANCE) return NSVCD_ERROR_ASK;
  if (q->segments > NSVCD__MAX_SEGMENTS || q->segments % NSVCD__LANES)
    return NSVCD_ERROR_SEGMENTS;
  if (!nsvcd__is_length(q->tolerance)) return NSVCD_ERROR_TOLERANCE;
  if (!nsvcd__is_length(q->clearance)) return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_length(q->slop)) return NSVCD_ERROR_SLOP;
  const int is_first = q->ask == NSVCD_ASK_FIRST;
  if (!nsvcd__is_length(q->to) || (q->to > 0 && q->ask == NSVCD_ASK_HIT))
    return NSVCD_ERROR_TO;
  if (!nsvcd__is_length(q->to_time) || q->to_time > (is_first ? 1.0f : 0.0f))
    return NSVCD_ERROR_TO_TIME;
  if (q->manifold && !is_first) return NSVCD_ERROR_MANIFOLD;
  // The network knows nothing of these.
  const int by_network = q->method == NSVCD_METHOD_NETWORK;
  const int needs_proof = q->clearance > 0 || q->slop > 0 || is_first || q->to > 0 ||
                          (q->ask == NSVCD_ASK_DISTANCE && !by_network);
  if (needs_proof && by_network) return NSVCD_ERROR_METHOD;
  const nsvcd_method wanted = needs_proof ? NSVCD_METHOD_PROOF : q->method;
  if (nsvcd__method_of(a->body, b->body, wanted) == NSVCD_METHOD_DEFAULT)
    return wanted == NSVCD_METHOD_NETWORK ? NSVCD_ERROR_LATENTS : NSVCD_ERROR_TRIANGLES;
#ifndef NSVCD_NO_NETWORK
  nsvcd__settings unused;
  return nsvcd__settings_of(&q->network, a->body->patches, b->body->patches, &unused);
#else
  return NSVCD_OK;
#endif
}

// ---- who moves

// The extent of a body, with what it goes beyond its triangles.
static float nsvcd__extent_of(const nsvcd_mover *mover) {
  const nsvcd_body *body = mover->body;
  return nsvcd__scale_of(mover) * (body->extent + (nsvcd__whole_radius(body) - body->radius));
}

// Does b move, seen in a's frame? Of two bodies the one that moves does, else the smaller one. If
// they are equal, any rule will do that does not depend on which of them is a: then both ways of
// asking get the same answer.
static int nsvcd__is_swapped(const nsvcd_mover *a, const nsvcd_mover *b) {
  const size_t count_a = nsvcd__pose_count(a);
  const size_t count_b = nsvcd__pose_count(b);
  if ((count_a > 1) != (count_b > 1)) return count_b > 1;
  const float size_a = nsvcd__extent_of(a);
  const float size_b = nsvcd__extent_of(b);
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

// What a question that is in order needs; NULL: what any may need.
static nsvcd__needs nsvcd__needs_of(const nsvcd_question *q) {
  nsvcd__needs needs = {NSVCD__TILE_SLOTS, NSVCD__TILE_SLOTS, 1, NSVCD__MAX_SEGMENTS, 0, 1};
#ifndef NSVCD_NO_NETWORK
  needs.candidates = NSVCD__SHORTLIST * NSVCD_MAX_PAIRS;
#endif
  if (!q) return needs;
  const nsvcd_body *a = q->a.body;
  const nsvcd_body *b = q->b.body;
  const int swapped = nsvcd__is_swapped(&q->a, &q->b);
  const size_t moving_groups = nsvcd__body_groups(swapped ? b : a);
  const size_t fixed_groups = nsvcd__body_groups(swapped ? a : b);
  if (moving_groups < NSVCD__TILE_SLOTS) needs.moving_groups = moving_groups;
  if (fixed_groups < NSVCD__TILE_SLOTS) needs.fixed_groups = fixed_groups;
  needs.large = nsvcd__is_tiled(a, b);
  if (q->segments) needs.segments = nsvcd__round_up(q->segments, NSVCD__LANES);
  needs.proof = nsvcd__method_of(a, b, q->method) == NSVCD_METHOD_PROOF;
#ifndef NSVCD_NO_NETWORK
  const nsvcd_network_options *o = &q->network;
  const size_t pairs = o->pairs ? o->pairs : NSVCD_DEFAULT_PAIRS;
  const size_t most = o->model == NSVCD_MODEL_TINY ? pairs : NSVCD__SHORTLIST * pairs;
  needs.candidates = most > NSVCD__PORTION ? most : NSVCD__PORTION;
  if (!a->weights_id || !b->weights_id) needs.candidates = 0;
#endif
  return needs;
}

NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question) {
  if (question && nsvcd__question_check(question)) return 0;
  const nsvcd__needs needs = nsvcd__needs_of(question);
  return nsvcd__query_layout(&needs, NULL);
}

// Checks a question, and that the workspace is large enough for it.
static NSVCD__NOINLINE nsvcd_result nsvcd__sweep_check(const nsvcd_question *q,
                                                       const void *workspace,
                                                       size_t workspace_size) {
  const nsvcd_result result = nsvcd__question_check(q);
  if (result) return result;
  if (!workspace || !nsvcd__is_aligned(workspace)) return NSVCD_ERROR_WORKSPACE;
  const nsvcd__needs needs = nsvcd__needs_of(q);
  const size_t size = nsvcd__query_layout(&needs, NULL);
  return workspace_size >= size ? NSVCD_OK : NSVCD_ERROR_WORKSPACE;
}

// Lays out a checked question in the workspace, and chooses who moves.
static NSVCD__NOINLINE nsvcd__query *nsvcd__query_open(nsvcd__isa isa, const nsvcd_question *q,
                                                       void *workspace) {
  const nsvcd__needs needs = nsvcd__needs_of(q);
  nsvcd__query *query = (nsvcd__query *)workspace;
  nsvcd__task *task = &query->task;
  (void)nsvcd__query_layout(&needs, (char *)workspace);
  query->isa = isa;
  task->swapped = nsvcd__is_swapped(&q->a, &q->b);
  const nsvcd_mover *moving = task->swapped ? &q->b : &q->a;
  const nsvcd_mover *fixed = task->swapped ? &q->a : &q->b;
  nsvcd__motion_init(moving, fixed, &task->motion);
  task->moving = moving->body;
  task->fixed = fixed->body;
  task->lengths = task->motion.scale * task->moving->extent + task->fixed->extent;
  task->lengths += nsvcd__pivot_arms(&task->motion);
  task->method = nsvcd__method_of(task->moving, task->fixed, q->method);
  task->question = q;
#ifndef NSVCD_NO_NETWORK
  task->decisive = NULL;
#if NSVCD__ROWS == 1
  task->row = (float *)(void *)query->broad_phase.met;
#endif
#endif
  return query;
}

// ---- answer, and write

static void nsvcd__swap(uint32_t *a, uint32_t *b) {
  const uint32_t first = *a;
  *a = *b;
  *b = first;
}

// Exchanges a and b in what was found about the moving body and the fixed one.
static void nsvcd__swap_contact(nsvcd_contact *c) {
  nsvcd__swap(&c->patch_a, &c->patch_b);
  nsvcd__swap(&c->triangle_a, &c->triangle_b);
  const float gap = c->gap < HUGE_VALF ? c->gap : 0;
  for (size_t k = 0; k < 3; k++) {
    c->point[k] += gap * c->normal[k];
    c->normal[k] = 0 - c->normal[k];
  }
}
static void nsvcd__swap_answer(nsvcd_answer *answer) {
  const nsvcd_pose moving = answer->safe.a;
  answer->safe.a = answer->safe.b;
  answer->safe.b = moving;
  nsvcd__swap(&answer->opinion.patch_a, &answer->opinion.patch_b);
  nsvcd__swap_contact(&answer->nearest);
  for (size_t n = 0; n < answer->contact_count; n++) nsvcd__swap_contact(&answer->contacts[n]);
  for (size_t k = 0; k < 3; k++) answer->push_out[k] = 0 - answer->push_out[k];
}

#ifndef NSVCD_NO_NETWORK
// Answers a question whose motion has been prepared, by the network.
static void nsvcd__answer_by_network(nsvcd__query *query, nsvcd__hint *hint,
                                     nsvcd_answer *answer) {
  nsvcd_opinion opinion;
  const int inside = NSVCD__KERNEL(query->isa, ask_network)(query, hint, &opinion);
  nsvcd__answer_begin(&query->task, opinion.logit > 0 ? NSVCD_HIT : NSVCD_FREE, answer);
  answer->inside = inside;
  answer->opinion = opinion;
  if (query->broad_phase.balls_met || inside) answer->by = NSVCD_BY_NETWORK;
  if (opinion.logit > 0) answer->time.high = opinion.time;
}
#endif

// Answers a question that has been checked and laid out. hint: NULL, or a batch's, for the network.
static void nsvcd__answer_query(nsvcd__query *query, nsvcd__hint *hint, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  (void)hint;
#ifndef NSVCD_NO_PROOF
  if (task->method == NSVCD_METHOD_PROOF) nsvcd__answer_by_proof(query, answer);
#endif
#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_NETWORK)
  // The network has an opinion on what a proof leaves undecided, unless a clearance, a slop or a
  // distance is asked for.
  const nsvcd_question *q = task->question;
  const int knows = task->moving->weights_id && task->fixed->weights_id &&
                    !(q->clearance > 0 || q->ask == NSVCD_ASK_DISTANCE || q->slop > 0);
  if (task->method == NSVCD_METHOD_PROOF && answer->verdict == NSVCD_UNDECIDED && knows)
    (void)NSVCD__KERNEL(query->isa, ask_network)(query, NULL, &answer->opinion);
#endif
#ifndef NSVCD_NO_NETWORK
  if (task->method == NSVCD_METHOD_NETWORK) nsvcd__answer_by_network(query, hint, answer);
#endif
  if (task->swapped) nsvcd__swap_answer(answer);
}

// As nsvcd_sweep_batch, by the kernels of one instruction set.
static nsvcd_result nsvcd__run_batch(nsvcd__isa isa, const nsvcd_question *questions,
                                     size_t count, void *workspace, size_t workspace_size,
                                     nsvcd_answer *answers) {
  nsvcd__hint hint = {0, 0, 0, 0};
  int swapped = 0;
  if (count > 0 && (!questions || !answers)) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < count; k++) {
    const nsvcd_result result = nsvcd__sweep_check(&questions[k], workspace, workspace_size);
    if (result) return result;
  }
  for (size_t k = 0; k < count; k++) {
    const nsvcd_question *q = &questions[k];
    nsvcd__query *query = nsvcd__query_open(isa, q, workspace);
    // The hint is about patches of the moving body and of the fixed one.
    const int same = k > 0 && q->a.body == q[-1].a.body && q->b.body == q[-1].b.body;
    if (!same || query->task.swapped != swapped) memset(&hint, 0, sizeof hint);
    swapped = query->task.swapped;
    nsvcd__answer_query(query, &hint, &answers[k]);
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer) {
  return nsvcd__run_batch(nsvcd__isa_at_hand(), question, 1, workspace, workspace_size,
                          answer);
}

NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers) {
  return nsvcd__run_batch(nsvcd__isa_at_hand(), questions, count, workspace, workspace_size,
                          answers);
}

#ifndef NSVCD_NO_GRADIENT
// As nsvcd_sweep_gradient, by the kernels of one instruction set.
static nsvcd_result nsvcd__run_gradient(nsvcd__isa isa, const nsvcd_question *question,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answer, float *gradient_a,
                                        float *gradient_b) {
  if (!question || !answer || (!gradient_a && !gradient_b)) return NSVCD_ERROR_ARGUMENT;
  if (question->method == NSVCD_METHOD_PROOF) return NSVCD_ERROR_METHOD;
  nsvcd_question by_network = *question;
  by_network.method = NSVCD_METHOD_NETWORK;
  const nsvcd_result result = nsvcd__sweep_check(&by_network, workspace, workspace_size);
  if (result) return result;
  nsvcd__query *query = nsvcd__query_open(isa, &by_network, workspace);
  nsvcd__task *task = &query->task;
  nsvcd__decisive decisive;
  task->decisive = &decisive;
  nsvcd__answer_query(query, NULL, answer);
  float *const out[2] = {task->swapped ? gradient_b : gradient_a,
                         task->swapped ? gradient_a : gradient_b};
  if (out[0]) memset(out[0], 0, 6 * task->motion.moving.count * sizeof(float));
  if (out[1]) memset(out[1], 0, 6 * task->motion.fixed.count * sizeof(float));
  if (answer->opinion.candidates > 0 && !answer->inside) nsvcd__gradient(query, out);
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b) {
  return nsvcd__run_gradient(nsvcd__isa_at_hand(), question, workspace, workspace_size, answer,
                             gradient_a, gradient_b);
}
#endif

// ================================================================ plan: a motion that hits nothing

// ------------------------------------------------------------------------------------- plan/spline
// In: control points (M + 2, F) of a spline. Out: the joints along it, their derivatives, and means
// of squares of these.
//
// Everything is linear in the control points, and the same for each joint: a joint at a time is the
// sum of its control points times weights (M + 2), and the mean of its square over the motion a
// quadratic form (M + 2, M + 2).

#ifndef NSVCD_NO_OPTIMIZER
// The derivative of that order at u of a polynomial of degree 5, times `scale`.
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

// The weights (M + 2) of the control points in the derivative of that order by t, which is clamped
// to [0,1].
static void nsvcd__spline_weights(size_t via, double t, size_t derivative, double *weights) {
  // Hermite's polynomials of u in [0,1]: of the position, velocity and acceleration at its left
  // end, then at its right.
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
    // both ends of the motion are at rest
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

// Adds to the form (M + 2, M + 2) `weight` times the mean over t of the derivative's square. By
// Gauss-Legendre quadrature with five nodes a piece, which is exact: the squares are of degree 8 at
// most.
static void nsvcd__add_mean_square(size_t via, size_t derivative, double weight,
                                   double *form) {
  static const double nodes[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                  0.953089922969332};
  static const double gauss[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                  0.239314335249683, 0.118463442528095};
  const size_t count = via + 2;
  const double pieces = (double)(via + 1);
  double w[NSVCD_MAX_VIA_POINTS + 2];
  for (size_t piece = 0; piece < via + 1; piece++) {
    for (size_t n = 0; n < 5; n++) {
      const double t = ((double)piece + nodes[n]) / pieces;
      nsvcd__spline_weights(via, t, derivative, w);
      for (size_t i = 0; i < count; i++) {
        const double scaled = weight * gauss[n] / pieces * w[i];
        for (size_t j = 0; j < count; j++) form[i * count + j] += scaled * w[j];
      }
    }
  }
}

// Cholesky's factor L of a (n, n), symmetric and positive definite, in its lower triangle: L L^T =
// a. What rounding makes negative is taken as small and positive. The upper triangle stays.
static void nsvcd__cholesky(double *a, size_t n) {
  for (size_t i = 0; i < n; i++) {
    const double least = 1e-9 * a[i * n + i];
    for (size_t j = 0; j <= i; j++) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < j; k++) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = j < i ? sum / a[j * n + j] : sqrt(sum > least ? sum : least);
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
// In: a problem and options. Out: a planner, laid out in the caller's workspace. The rooms of this
// floor, each of which uses those before it:
//
//   spline      control points -> joints along a trajectory, and their derivatives
//   problem     checks, defaults, memory
//   culling     which bodies may meet in which segments; poses along a trajectory -> cost of
//               collision, and its derivative by the poses (wrenches)
//   cost        control points -> smoothness + limits + collision, and the derivative by the
//               control points
//   explore     MPPI: smooth random changes of a mean, weighted by exp(-cost / temperature)
//   refine      L-BFGS with bundled gradients, in the metric of the smoothness
//   plan        start and goal, several seeds, and the last check
//
// The planner asks as any program does, by the public functions. Of the private ones of query and
// motion it uses nsvcd__settings_of, nsvcd__poses_check and nsvcd__is_aligned, to refuse what a
// query would refuse, and nsvcd__world_pose_between.
//
// A trajectory is sampled at *moments*, uniform in t, both ends among them; a *segment* lies
// between two of them. A *rollout* is one of MPPI's random trajectories; a *bundle* is the random
// changes over which L-BFGS averages a gradient. Letters of shapes: M via points, F joints, B
// bodies, P pairs.

#ifndef NSVCD_NO_OPTIMIZER
// Cost of joints beyond their limits, per radian^2 or metre^2, averaged over the moments.
#define NSVCD__LIMIT_COST 1e5f
// That cost begins this share of a joint's range before the limit.
#define NSVCD__LIMIT_MARGIN 0.005f
// Balls of patches grow by this share of their radii in the search:
// nsvcd_network_options.inflate.
#define NSVCD__PLAN_INFLATE 0.25f
// Logits over which the slope of the cost of collision grows from 0 to 1.
#define NSVCD__SOFT_LOGITS 2
// Segments that one query may rule out together.
#define NSVCD__RUN_SEGMENTS 8
// A joint's step for differences: a constant, and a share of its value.
#define NSVCD__JOINT_STEP 1e-3f
#define NSVCD__JOINT_STEP_FRACTION 1e-6f
// MPPI: a rollout this many temperatures above the least cost weighs nothing.
#define NSVCD__WEIGHTLESS 10
// MPPI: the temperature is such that one in this many rollouts is within two of the least cost.
#define NSVCD__ELITE 10
// MPPI: the mean moves by this share towards the rollouts' mean.
#define NSVCD__MEAN_STEP 0.9f
// MPPI: ends after this many iterations without a gain of 1 %, once the best is free.
#define NSVCD__PATIENCE 3
// L-BFGS: steps that are remembered, and step lengths that are tried.
#define NSVCD__HISTORY 8
#define NSVCD__STEPS 5
// Further refinements, each with a wider margin, while the proof finds hits.
#define NSVCD__RETRIES 3
// Segments of the last check for each of the finest stage.
#define NSVCD__CHECKS 16
// Times, at least, at which the deviation of a piece of the spline is measured.
#define NSVCD__DEVIATION_SAMPLES 16

// A body, in its own axes: its bounding sphere, and the box of its patches.
typedef struct nsvcd__shape {
  nsvcd__sphere sphere;
  nsvcd__box box;
} nsvcd__shape;

// A body at a moment.
typedef struct nsvcd__stance {
  nsvcd__transform pose;
  // of its bounding sphere, from its origin, in the world's axes
  nsvcd__f3 centre;
  // sqrt(1 - cos(h)), if it turns by 2 h until the next moment
  float bend;
} nsvcd__stance;

// How trajectories are sampled and searched: exploring, refining, or in the last check.
typedef struct nsvcd__stage {
  size_t via, moments;  // M; segments + 1
  size_t numbers;       // M F
  size_t bytes;         // of all control points
  size_t iterations;
  size_t draws;      // rollouts of an iteration, or gradients in a bundle
  float noise;       // their standard deviation, radians or metres
  double *form;      // (M + 2, M + 2): smoothness
  double *factor;    // (M, M): Cholesky's, of the via points' rows and columns
  double deviation;  // the largest of a via point, of factor^-T times normal numbers
  float *weights;    // (moments, M + 2): of the control points, in the joints
} nsvcd__stage;

// What a trajectory costs.
typedef struct nsvcd__cost {
  float total, smoothness, collision;
  int collides;  // at the moments or in the segments that were asked about
  size_t joint;  // that leaves its limits, or NSVCD_NONE
  // the greatest logit of a query, its time and its pair
  float logit, time;
  size_t pair;
  int proven;  // that query was answered by proof, and did not find the pair free
} nsvcd__cost;

typedef struct nsvcd__planner {
  const nsvcd_plan_problem *in;  // the problem
  nsvcd_plan_options options;    // with the defaults filled in
  nsvcd__stage explore, refine, check;
  void *query;  // workspace of queries
  size_t query_size;
  uint64_t random;                      // the state of the random numbers
  float first_noise[NSVCD_MAX_JOINTS];  // deviations of the first rollouts
  nsvcd_result error;                   // of a query or a pose
  int cancelled;                        // by the progress callback
  nsvcd_plan_answer answer;             // what is counted so far
  nsvcd__cost cost;                     // of start or goal, then of `result`

  // the trajectory at hand
  float *path;             // (moments, F)
  nsvcd_pose *poses;       // (moments, B)
  nsvcd__stance *stances;  // (moments, B)
  nsvcd__shape *shapes;    // (B)
  unsigned char *meets;    // (moments): may the pair at hand meet there?
  uint32_t *queue;         // (P): pairs, in the order of queries
  float *wrenches;         // (moments, B, 6)
  nsvcd_pose *moved;       // (B): at a moment, with one joint moved
  float *jacobian;         // (B, 6, F)
  float *by_path;          // (F): derivative by the joints at a moment

  // control points, (M + 2, F) each
  float *result;    // the best of all seeds
  float *control;   // MPPI's mean, or L-BFGS's last point
  float *best;      // of this seed
  float *trial;     // whose cost is wanted
  float *gradient;  // there

  // via points, (M, F) each
  float *sum;      // mean of offsets, or of gradients
  float *offset;   // a change, or a direction
  float *drawn;    // (draws, M, F): the random changes
  float *costs;    // (draws): of rollouts, then their weights
  float *steps;    // (HISTORY, M, F): of L-BFGS
  float *changes;  // (HISTORY, M, F): of the gradient, by these steps
  double *vector;  // (M + 2): scratch
} nsvcd__planner;

static const nsvcd__cost nsvcd__no_cost = {
    0, 0, 0, 0, NSVCD_NONE, -NSVCD_LOGIT_CERTAIN, 0, NSVCD_NONE, 0};

static int nsvcd__is_free(const nsvcd__cost *cost) {
  return !cost->collides && cost->joint == NSVCD_NONE;
}

// ---- memory

static size_t nsvcd__larger(size_t a, size_t b) {
  return a > b ? a : b;
}

// A weight: the default for 0, and 0 for what is negative.
static float nsvcd__weight_of(float given, float otherwise) {
  return given > 0 ? given : given < 0 ? 0 : otherwise;
}

// A stage as the caller gave it, with the defaults for zeros. Returns 0 if it is out of range.
static int nsvcd__stage_of(const nsvcd_plan_stage *given, nsvcd_plan_stage otherwise,
                           nsvcd__stage *stage) {
  const size_t segments = given->segments ? given->segments : otherwise.segments;
  stage->via = given->via_points ? given->via_points : otherwise.via_points;
  stage->moments = segments + 1;
  stage->iterations = given->iterations ? given->iterations : otherwise.iterations;
  if (given->iterations == NSVCD_NONE) stage->iterations = 0;
  stage->draws = given->draws ? given->draws : otherwise.draws;
  stage->noise = nsvcd__weight_of(given->noise, otherwise.noise);
  return stage->via <= NSVCD_MAX_VIA_POINTS && segments <= NSVCD_MAX_PLAN_SEGMENTS &&
         stage->draws <= 10000 && stage->iterations <= 100000;
}

// Is the problem well formed?
static nsvcd_result nsvcd__problem_check(const nsvcd_plan_problem *in) {
  if (!in || !in->kinematics) return NSVCD_ERROR_ARGUMENT;
  if (in->joints < 1 || in->joints > NSVCD_MAX_JOINTS || in->body_count > 65536)
    return NSVCD_ERROR_COUNT;
  if (!in->low || !in->high || !in->start || !in->goal) return NSVCD_ERROR_ARGUMENT;
  const int by_network = !in->collision;
  if (in->pair_count > 0 && (!in->pairs || (by_network && !in->bodies)))
    return NSVCD_ERROR_ARGUMENT;
  // a body in no pair may be NULL
  for (size_t b = 0; in->bodies && b < in->body_count; b++) {
    const nsvcd_body *body = in->bodies[b];
    const nsvcd_result error = body ? nsvcd__body_check(body, SIZE_MAX) : NSVCD_OK;
    if (error) return error;
  }
  for (size_t k = 0; k < in->pair_count; k++) {
    const size_t a = in->pairs[k].a;
    const size_t b = in->pairs[k].b;
    if (a >= in->body_count || b >= in->body_count || a == b) return NSVCD_ERROR_PAIR;
    if (by_network && (!in->bodies[a] || !in->bodies[b])) return NSVCD_ERROR_ARGUMENT;
  }
  return NSVCD_OK;
}

// Checks problem and options; fills in the defaults.
static nsvcd_result nsvcd__planner_settings(const nsvcd_plan_problem *problem,
                                            const nsvcd_plan_options *options,
                                            nsvcd__planner *p) {
  // via points, segments, iterations, draws, noise
  static const nsvcd_plan_stage explore = {5, 24, 40, 100, 0.3f};
  static const nsvcd_plan_stage refine = {10, 22, 10, 10, 0.01f};
  nsvcd__settings unused;
  memset(p, 0, sizeof *p);
  nsvcd_result error = nsvcd__problem_check(problem);
  if (error) return error;
  p->in = problem;
  if (options) p->options = *options;
  nsvcd_plan_options *o = &p->options;
  const float floats[8] = {o->velocity, o->acceleration, o->jerk,          o->collision,
                           o->duration, o->margin,       o->explore.noise, o->refine.noise};
  if (!nsvcd__in_range(floats, 8, FLT_MAX)) return NSVCD_ERROR_PLAN;
  error = nsvcd__settings_of(&o->sweep.network, 1, 1, &unused);
  if (error) return error;
  if (!nsvcd__stage_of(&o->explore, explore, &p->explore) ||
      !nsvcd__stage_of(&o->refine, refine, &p->refine))
    return NSVCD_ERROR_STAGE;
  if (o->refine.iterations == NSVCD_NONE) p->refine.via = p->explore.via;

  o->seeds = o->seeds ? o->seeds : 6;
  o->velocity = nsvcd__weight_of(o->velocity, 10);
  o->acceleration = nsvcd__weight_of(o->acceleration, 2);
  o->jerk = nsvcd__weight_of(o->jerk, 10);
  // some form has to be positive definite
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
  return o->check <= most && o->seeds <= 1000 ? NSVCD_OK : NSVCD_ERROR_PLAN;
}

// nsvcd__take, of rows of floats.
static float *nsvcd__take_floats(char *base, uint64_t *used, size_t rows, size_t floats) {
  return (float *)nsvcd__take(base, used, rows, floats * sizeof(float));
}

// Lays the planner's arrays out from `base` on, or, if that is NULL, only measures them. Returns
// the bytes; 0 if they exceed SIZE_MAX.
static size_t nsvcd__planner_memory(nsvcd__planner *p, char *base) {
  nsvcd__stage *const stages[3] = {&p->explore, &p->refine, &p->check};
  float **const points[7] = {&p->result,   &p->control, &p->best,  &p->trial,
                             &p->gradient, &p->sum,     &p->offset};
  const size_t f = p->in->joints;
  const size_t bodies = p->in->body_count;
  const size_t via = nsvcd__larger(p->explore.via, p->refine.via);
  const size_t draws = nsvcd__larger(p->explore.draws, p->refine.draws);
  const size_t finest = nsvcd__larger(p->explore.moments, p->refine.moments);
  const size_t moments = nsvcd__larger(p->check.moments, finest);
  const size_t poses = moments * bodies;
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
    stage->factor = NSVCD__TAKE_ROWS(double, stage->via * stage->via, base, &used);
    stage->weights = nsvcd__take_floats(base, &used, stage->moments, all);
  }

  p->path = nsvcd__take_floats(base, &used, moments, f);
  p->poses = NSVCD__TAKE_ROWS(nsvcd_pose, poses, base, &used);
  p->stances = NSVCD__TAKE_ROWS(nsvcd__stance, poses, base, &used);
  p->shapes = NSVCD__TAKE_ROWS(nsvcd__shape, bodies, base, &used);
  p->meets = NSVCD__TAKE_ROWS(unsigned char, moments, base, &used);
  p->queue = NSVCD__TAKE_ROWS(uint32_t, p->in->pair_count, base, &used);
  p->wrenches = nsvcd__take_floats(base, &used, poses, 6);
  p->moved = NSVCD__TAKE_ROWS(nsvcd_pose, bodies, base, &used);
  p->jacobian = nsvcd__take_floats(base, &used, bodies, 6 * f);
  p->by_path = nsvcd__take_floats(base, &used, 1, f);

  for (size_t k = 0; k < 7; k++) *points[k] = nsvcd__take_floats(base, &used, 1, point);
  p->drawn = nsvcd__take_floats(base, &used, draws, point);
  p->costs = nsvcd__take_floats(base, &used, 1, draws);
  p->steps = nsvcd__take_floats(base, &used, NSVCD__HISTORY, point);
  p->changes = nsvcd__take_floats(base, &used, NSVCD__HISTORY, point);
  p->vector = NSVCD__TAKE_ROWS(double, via + 2, base, &used);
  return used <= SIZE_MAX ? (size_t)used : 0;
}

// Fills in what a stage computes once.
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
  nsvcd__cholesky(stage->factor, via);

  // the variance of via point k is |L^-1 e_k|^2
  stage->deviation = 0;
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
// In: the poses at the moments, and of each body its bounding sphere and the box of its patches.
// Out: the cost of collision and its derivative by the poses.
//
// A plan asks about each pair in each segment, and most of these are far from a collision. A broad
// phase of whole bodies rules those out for less than a query costs: p->meets (moments) is 0 where
// a query about the segment that begins there would prove it free. (The broad phase of
// search/search then goes through the patches of two bodies in one segment.)
//
// It is conservative. A sphere's centre is covered by the box about its two ends, which grows by as
// much as the centre may deviate from their chord. The motion is the query's: as b sees it, a's
// origin goes straight, and a turns evenly about one axis by an angle c, which is at most what a
// and b turn in the world. Either of two tests rules a pair out:
//
//   a's sphere against b's box. Its centre turns about a's origin on an arc of radius `arm` or
//   less, and deviates by at most the arc's height, arm (1 - cos(c / 2)).
//
//   b's sphere against a's box. As a sees it, its centre v moves and turns at once. It deviates by
//   at most an eighth of its acceleration, c^2 |v| + 2 c |u|, where u is its displacement in b's
//   axes: at most that in a's axes + c |v|. In all: c (c |v| 3 / 8 + displacement in a's axes / 4).

#ifndef NSVCD_NO_OPTIMIZER
// The shapes of all bodies.
static void nsvcd__find_shapes(nsvcd__planner *p) {
  for (size_t b = 0; p->in->bodies && b < p->in->body_count; b++) {
    const nsvcd_body *body = p->in->bodies[b];
    nsvcd__shape shape = {{{0, 0, 0}, 0},
                          {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    float position[3];
    float r;
    if (!body) continue;
    const nsvcd_body_facts facts = nsvcd_body_describe(body);
    shape.sphere.centre = nsvcd__f3_load(facts.centre);
    shape.sphere.radius = facts.radius;
    for (uint32_t i = 0; nsvcd_body_patch(body, i, position, &r); i++) {
      const nsvcd__f3 about = nsvcd__f3_of(r, r, r);
      const nsvcd__f3 centre = nsvcd__f3_load(position);
      shape.box.low = nsvcd__f3_min(shape.box.low, nsvcd__f3_sub(centre, about));
      shape.box.high = nsvcd__f3_max(shape.box.high, nsvcd__f3_add(centre, about));
    }
    p->shapes[b] = shape;
  }
}

// The stances of all bodies, from p->poses.
static void nsvcd__find_stances(nsvcd__planner *p, size_t moments) {
  const size_t bodies = p->in->body_count;
  for (size_t b = 0; p->in->bodies && b < bodies; b++) {
    if (!p->in->bodies[b]) continue;
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

// Does the bounding sphere of `body` stay farther than the clearance from the box of `other`, from
// moment s to s + stride? rests: in the query `body` rests, and `other` moves.
static inline int nsvcd__passes_by(const nsvcd__planner *p, size_t body, size_t other,
                                   int rests, size_t s, size_t stride) {
  const nsvcd__sphere *sphere = &p->shapes[body].sphere;
  const nsvcd__box *box = &p->shapes[other].box;
  const nsvcd__stance *now = p->stances + s * p->in->body_count;
  // the sphere's centre as `other` sees it at both ends, and the sum of its distances from the
  // origin of `other`
  nsvcd__f3 seen[2];
  float distance = 0;
  for (size_t k = 0; k < 2; k++) {
    const nsvcd__stance *at = now + k * stride * p->in->body_count;
    const nsvcd__transform *from = &at[other].pose;
    const nsvcd__f3 origin = nsvcd__f3_sub(at[body].pose.position, from->position);
    const nsvcd__f3 centre = nsvcd__f3_add(origin, at[body].centre);
    seen[k] = nsvcd__mat3_apply_transpose(&from->rotation, centre);
    distance += nsvcd__f3_norm(centre);
  }

  // The root of 1 - cos of a sum of angles is at most the sum of their roots, and c < 3.15 bend.
  const float bend = now[body].bend + now[other].bend;
  float deviation = nsvcd__f3_norm(sphere->centre) * bend * bend;
  if (rests) {
    const nsvcd__f3 travel = nsvcd__f3_sub(seen[1], seen[0]);
    const float length = fabsf(travel.x) + fabsf(travel.y) + fabsf(travel.z);
    deviation = (3.75f * bend * distance + 0.8f * length) * bend;
  }
  const float radius = 1.00001f * sphere->radius + p->options.sweep.clearance;
  const float grown = radius + (float)stride * deviation + NSVCD__ROUNDING * distance;
  const nsvcd__f3 about = nsvcd__f3_of(grown, grown, grown);
  const nsvcd__f3 low = nsvcd__f3_min(seen[0], seen[1]);
  const nsvcd__f3 high = nsvcd__f3_max(seen[0], seen[1]);
  return nsvcd__f3_exceeds(low, nsvcd__f3_add(box->high, about)) |
         nsvcd__f3_exceeds(nsvcd__f3_sub(box->low, about), high);
}

// Marks in p->meets the segments (stride 1) or moments (stride 0) in which a pair may meet.
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
  const nsvcd__quat q = nsvcd__quat_load(b->rotation);
  const nsvcd__mat3 axes = nsvcd__mat3_of(q);
  const nsvcd__f3 from = nsvcd__f3_load(b->position);
  const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__f3_load(a->position), from);
  const nsvcd__quat back = nsvcd__quat_inverse(q);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__mat3_apply_transpose(&axes, offset), out.position);
  nsvcd__quat_store(nsvcd__quat_mul(back, nsvcd__quat_load(a->rotation)), out.rotation);
  return out;
}

// The cost of a logit: its excess over -margin, with a smooth onset. *slope: the derivative by it.
static float nsvcd__cost_of_logit(float logit, float margin, float *slope) {
  const float x = logit + margin;
  const float soft = NSVCD__SOFT_LOGITS;
  *slope = x <= 0 ? 0 : x < soft ? x / soft : 1;
  return x <= 0 ? 0 : x < soft ? 0.5f * x * x / soft : x - 0.5f * soft;
}

// Adds to the wrenches (B, 6) a wrench on a (6), in b's axes, times `scale`, and the opposite one
// on b. A wrench is the derivative by a pose: by its position, and by a small rotation about that.
// poses: (B).
static void nsvcd__add_wrench_on_pair(const nsvcd_body_pair *pair, const nsvcd_pose *poses,
                                      float scale, const float *wrench, float *wrenches) {
  const nsvcd__mat3 axes = nsvcd__mat3_of(nsvcd__quat_load(poses[pair->b].rotation));
  const nsvcd__f3 force = nsvcd__mat3_apply(&axes, nsvcd__f3_load(wrench));
  const nsvcd__f3 torque = nsvcd__mat3_apply(&axes, nsvcd__f3_load(wrench + 3));
  const nsvcd__f3 from = nsvcd__f3_load(poses[pair->b].position);
  const nsvcd__f3 arm = nsvcd__f3_sub(nsvcd__f3_load(poses[pair->a].position), from);
  const nsvcd__f3 back = nsvcd__f3_add(torque, nsvcd__f3_cross(arm, force));
  nsvcd__add_wrench(scale, force, torque, wrenches + 6 * pair->a);
  nsvcd__add_wrench(-scale, force, back, wrenches + 6 * pair->b);
}

// A logit for any answer. An undecided one counts as a hit.
static float nsvcd__logit_of(const nsvcd_answer *answer) {
  if (answer->verdict != NSVCD_UNDECIDED && answer->opinion.asked)
    return answer->opinion.logit;
  return answer->verdict == NSVCD_FREE ? -NSVCD_LOGIT_CERTAIN : NSVCD_LOGIT_CERTAIN;
}

// The answer about pair k from moment `first` on, over so many segments: by the network, or, in the
// last check, by the method of the options. gradient: (segments + 1, 6), or NULL.
static nsvcd_answer nsvcd__ask_segments(nsvcd__planner *p, uint32_t k, size_t first,
                                        size_t segments, int at_end, float *gradient) {
  const nsvcd_body_pair *pair = &p->in->pairs[k];
  nsvcd_pose motion[NSVCD__RUN_SEGMENTS + 1];
  for (size_t n = 0; n <= segments; n++) {
    const nsvcd_pose *row = p->poses + (first + n) * p->in->body_count;
    motion[n] = nsvcd__relative_pose(&row[pair->a], &row[pair->b]);
  }

  const nsvcd_mover a = {p->in->bodies[pair->a], motion, segments + 1, NULL, 0, {0}};
  const nsvcd_mover b = {p->in->bodies[pair->b], NULL, 0, NULL, 0, {0}};
  nsvcd_question question = p->options.sweep;
  question.a = a;
  question.b = b;
  question.ask = NSVCD_ASK_HIT;
  question.to = question.to_time = 0;
  question.manifold = 0;
  if (!at_end) {
    question.method = NSVCD_METHOD_NETWORK;
    question.clearance = 0;
    question.slop = 0;
    // so that there is a slope before contact
    if (question.network.inflate <= 0) question.network.inflate = NSVCD__PLAN_INFLATE;
  }

  nsvcd_answer answer;
  nsvcd_result error;
  memset(&answer, 0, sizeof answer);
  answer.verdict = NSVCD_FREE;  // on an error
  if (gradient)
    error = nsvcd_sweep_gradient(&question, p->query, p->query_size, &answer, gradient, NULL);
  else
    error = nsvcd_sweep(&question, p->query, p->query_size, &answer);
  if (error) p->error = error;
  p->answer.sweeps++;
  return answer;
}

// How p->poses are asked about.
typedef struct nsvcd__asking {
  size_t moments;
  size_t stride;    // 1: in segments, 0: at moments
  int at_end;       // in the last check
  float limit;      // the sum may stop beyond it
  float *wrenches;  // (moments, B, 6), added to, or NULL
} nsvcd__asking;

// Adds the cost of pair k from moment s to s + stride.
static void nsvcd__add_segment(nsvcd__planner *p, uint32_t k, size_t s,
                               const nsvcd__asking *how, nsvcd__cost *cost) {
  const nsvcd_body_pair *pair = &p->in->pairs[k];
  float gradient[2 * 6];
  float slope;
  float *wanted = how->wrenches ? gradient : NULL;
  const nsvcd_answer answer = nsvcd__ask_segments(p, k, s, how->stride, how->at_end, wanted);
  const float logit = nsvcd__logit_of(&answer);
  const int collides = answer.verdict != NSVCD_FREE;
  if (logit > cost->logit) {
    const int by_proof = answer.by == NSVCD_BY_PROOF;
    const float t = by_proof ? answer.nearest.time : answer.opinion.time;
    const float at = (float)s + (float)how->stride * t;
    cost->logit = logit;
    cost->pair = k;
    // the network does no work
    cost->proven = collides && answer.work > 0;
    cost->time = how->moments > 1 ? at / (float)(how->moments - 1) : 0;
  }
  cost->collides |= collides;
  cost->collision += nsvcd__cost_of_logit(logit, p->options.margin, &slope);
  for (size_t i = 0; wanted && slope > 0 && i <= how->stride; i++) {
    const size_t row = (s + i) * p->in->body_count;
    nsvcd__add_wrench_on_pair(pair, p->poses + row, slope, gradient + 6 * i,
                              how->wrenches + 6 * row);
  }
}

// Adds the cost of pair k along the trajectory.
static void nsvcd__add_pair(nsvcd__planner *p, uint32_t k, const nsvcd__asking *how,
                            nsvcd__cost *cost) {
  const size_t end = how->moments - how->stride;
  const int in_runs = how->stride && !how->at_end;
  size_t asked = 0;  // runs before this segment have been
  nsvcd__find_meetings(p, &p->in->pairs[k], how->moments, how->stride);
  for (size_t s = 0; s < end && cost->collision <= how->limit && !p->error; s++) {
    if (!p->meets[s]) continue;
    if (in_runs && s >= asked) {
      // A run of segments in which the pair may meet, all in one query. If that is far from a
      // collision, the run costs nothing.
      size_t run = 1;
      while (run < NSVCD__RUN_SEGMENTS && s + run < end && p->meets[s + run]) run++;
      asked = s + run;
      if (run > 1) {
        const nsvcd_answer answer = nsvcd__ask_segments(p, k, s, run, 0, NULL);
        if (nsvcd__logit_of(&answer) <= -p->options.margin) {
          s += run - 1;
          continue;
        }
      }
    }
    nsvcd__add_segment(p, k, s, how, cost);
  }
}

// Adds the cost of collision of p->poses, by the problem's own function or by queries, up to the
// first sum above `limit`. wrenches: (moments, B, 6), added to, or NULL. at_end: in the last check.
static void nsvcd__add_collision(nsvcd__planner *p, size_t moments, float limit,
                                 float *wrenches, int at_end, nsvcd__cost *cost) {
  const size_t stride = !p->options.discrete && moments > 1;
  const nsvcd__asking how = {moments, stride, at_end, limit, wrenches};
  if (p->in->collision) {
    cost->collision =
        p->in->collision(p->in->user, p->poses, moments, limit, &cost->collides, wrenches);
    cost->logit = cost->collision;
    return;
  }
  nsvcd__find_stances(p, moments);
  for (size_t n = 0; n < p->in->pair_count && cost->collision <= limit; n++) {
    const uint32_t k = p->queue[n];
    const float before = cost->collision;
    nsvcd__add_pair(p, k, &how, cost);
    // A pair that costs comes earlier next time, so that bad trajectories end early.
    if (n > 0 && cost->collision > before) {
      p->queue[n] = p->queue[n - 1];
      p->queue[n - 1] = k;
    }
  }
}
#endif  // NSVCD_NO_OPTIMIZER

// --------------------------------------------------------------------------------------- plan/cost
// In: control points. Out: what they cost, smoothness + limits + collision, and its derivative by
// them.

#ifndef NSVCD_NO_OPTIMIZER
// From the wrenches (B, 6) at a moment to the derivative by its joints, p->by_path (F), by
// differences of `kinematics`. poses: (B), at these joints.
static void nsvcd__by_differences(nsvcd__planner *p, const float *joints,
                                  const nsvcd_pose *poses, const float *wrenches) {
  float moved[NSVCD_MAX_JOINTS];
  memcpy(moved, joints, p->in->joints * sizeof *moved);
  for (size_t j = 0; j < p->in->joints; j++) {
    moved[j] = joints[j] + (NSVCD__JOINT_STEP + NSVCD__JOINT_STEP_FRACTION * fabsf(joints[j]));
    const float step = moved[j] - joints[j];  // as rounded
    p->in->kinematics(p->in->user, moved, p->moved);
    moved[j] = joints[j];
    p->by_path[j] = 0;
    for (size_t b = 0; b < p->in->body_count; b++) {
      const nsvcd__quat q = nsvcd__quat_load(poses[b].rotation);
      const nsvcd__quat r = nsvcd__quat_load(p->moved[b].rotation);
      const float twice = nsvcd__quat_dot(q, r) < 0 ? -2.0f : 2.0f;
      const nsvcd__f3 turn = nsvcd__f3_scale(nsvcd__quat_turn(q, r), twice / step);
      const nsvcd__f3 from = nsvcd__f3_load(poses[b].position);
      const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__f3_load(p->moved[b].position), from);
      p->by_path[j] += nsvcd__f3_dot(nsvcd__f3_row(wrenches, 2 * b), offset) / step;
      p->by_path[j] += nsvcd__f3_dot(nsvcd__f3_row(wrenches, 2 * b + 1), turn);
    }
  }
}

// The poses (moments, B) at joints (moments, F), with quaternions of unit length.
static void nsvcd__find_poses(nsvcd__planner *p, const float *joints, size_t moments,
                              nsvcd_pose *poses) {
  const size_t bodies = p->in->body_count;
  const size_t count = moments * bodies;
  for (size_t s = 0; s < moments; s++)
    p->in->kinematics(p->in->user, joints + s * p->in->joints, poses + s * bodies);
  const nsvcd_result error = count > 0 ? nsvcd__poses_check(poses, count) : NSVCD_OK;
  if (error) p->error = error;
  for (size_t k = 0; k < count && !error; k++) {
    const nsvcd__quat unit = nsvcd__quat_unit(nsvcd__quat_load(poses[k].rotation));
    nsvcd__quat_store(unit, poses[k].rotation);
  }
}

// The smoothness of a trajectory; gradient: (M + 2, F), written, or NULL.
static float nsvcd__smoothness(const nsvcd__planner *p, const nsvcd__stage *stage,
                               const float *control, float *gradient) {
  const size_t f = p->in->joints;
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

// Fills p->path with the joints at the moments. Adds the cost of those beyond their limits, or
// within the margin before these. gradient: (M + 2, F), added to, or NULL.
static void nsvcd__add_limits(nsvcd__planner *p, const nsvcd__stage *stage,
                              const float *control, float *gradient, nsvcd__cost *cost) {
  const size_t f = p->in->joints;
  const size_t all = stage->via + 2;
  const float fraction = NSVCD__LIMIT_COST / (float)stage->moments;
  // via points too: moments may be too few to hit one
  for (size_t k = f; k < f + stage->numbers && cost->joint == NSVCD_NONE; k++) {
    if (nsvcd__leaves_limits(p->in, k % f, control[k])) cost->joint = k % f;
  }
  for (size_t s = 0; s < stage->moments; s++) {
    const float *w = stage->weights + s * all;
    for (size_t j = 0; j < f; j++) {
      float value = 0;
      for (size_t k = 0; k < all; k++) value += w[k] * control[k * f + j];
      p->path[s * f + j] = value;

      const float low = p->in->low[j];
      const float high = p->in->high[j];
      const float inner = NSVCD__LIMIT_MARGIN * (high - low);
      float out = value > high - inner ? value - high + inner : 0;
      if (value < low + inner) out = value - low - inner;
      cost->total += fraction * out * out;
      if (nsvcd__leaves_limits(p->in, j, value)) cost->joint = j;
      for (size_t k = 0; gradient && k < all; k++)
        gradient[k * f + j] += 2 * fraction * out * w[k];
    }
  }
}

// Adds the derivative of the cost of collision, from p->wrenches, to the gradient (M + 2, F).
static void nsvcd__add_collision_gradient(nsvcd__planner *p, const nsvcd__stage *stage,
                                          float *gradient) {
  const size_t f = p->in->joints;
  const size_t numbers = 6 * p->in->body_count;
  const size_t all = stage->via + 2;
  for (size_t s = 0; s < stage->moments; s++) {
    const float *joints = p->path + s * f;
    const float *wrenches = p->wrenches + s * numbers;
    int has_any = 0;
    for (size_t k = 0; k < numbers && !has_any; k++)
      has_any = wrenches[k] < 0 || wrenches[k] > 0;
    if (!has_any) continue;
    if (p->in->jacobian) {
      p->in->jacobian(p->in->user, joints, p->jacobian);
      for (size_t j = 0; j < f; j++) {
        p->by_path[j] = 0;
        for (size_t i = 0; i < numbers; i++)
          p->by_path[j] += wrenches[i] * p->jacobian[i * f + j];
      }
    } else {
      nsvcd__by_differences(p, joints, p->poses + s * p->in->body_count, wrenches);
    }
    for (size_t k = 0; k < all; k++) {
      const float weight = p->options.collision * stage->weights[s * all + k];
      for (size_t j = 0; j < f; j++) gradient[k * f + j] += weight * p->by_path[j];
    }
  }
}

// The cost of a trajectory; the sum may stop beyond `limit`. gradient: (M + 2, F), written, or
// NULL.
static nsvcd__cost nsvcd__cost_of(nsvcd__planner *p, const nsvcd__stage *stage,
                                  const float *control, float limit, float *gradient) {
  const size_t numbers = 6 * stage->moments * p->in->body_count;
  const float weight = p->options.collision;
  const int at_end = stage == &p->check;
  float *wrenches = gradient ? p->wrenches : NULL;
  nsvcd__cost cost = nsvcd__no_cost;
  p->answer.trajectories++;
  cost.smoothness = nsvcd__smoothness(p, stage, control, gradient);
  cost.total = cost.smoothness;
  nsvcd__add_limits(p, stage, control, gradient, &cost);
  if (cost.total > limit || p->error) return cost;
  nsvcd__find_poses(p, p->path, stage->moments, p->poses);
  if (p->error) return cost;

  const float left = weight > 0 ? (limit - cost.total) / weight : INFINITY;
  if (wrenches) memset(wrenches, 0, numbers * sizeof *wrenches);
  nsvcd__add_collision(p, stage->moments, left, wrenches, at_end, &cost);
  cost.total += weight * cost.collision;
  if (gradient) nsvcd__add_collision_gradient(p, stage, gradient);
  if (!nsvcd__is_finite(cost.total)) p->error = NSVCD_ERROR_NUMBER;
  return cost;
}
#endif  // NSVCD_NO_OPTIMIZER

// ------------------------------------------------------------------------------------ plan/explore
// In: control points. Out: better ones, by MPPI (Williams et al. 2017): their mean moves to that of
// smooth random changes, weighted by exp(-cost / temperature).
//
// Differences from the article: via points of a spline are changed, not the controls of a dynamic
// system; the temperature and the deviations of the changes follow the costs of the rollouts.

#ifndef NSVCD_NO_OPTIMIZER
// A standard normal number: Box and Muller.
static double nsvcd__normal(nsvcd__planner *p) {
  const double size = nsvcd__random(&p->random);
  return sqrt(-2 * log(size)) * cos(6.283185307179586 * nsvcd__random(&p->random));
}

// A smooth random change of the via points, (M, F), zero at the ends. Its inverse covariance is the
// form of the smoothness, scaled: the largest standard deviation of a joint is deviations (F).
static void nsvcd__smooth_noise(nsvcd__planner *p, const nsvcd__stage *stage,
                                const float *deviations, float *out) {
  const size_t f = p->in->joints;
  const size_t via = stage->via;
  for (size_t j = 0; j < f; j++) {
    for (size_t k = 0; k < via; k++) p->vector[k] = nsvcd__normal(p);
    nsvcd__solve_upper(stage->factor, via, p->vector);
    const double scale = (double)deviations[j] / stage->deviation;
    for (size_t k = 0; k < via; k++) out[k * f + j] = (float)(scale * p->vector[k]);
  }
}

// out (M + 2, F) = control + scale * offset (M, F), with via points clamped to the limits.
static void nsvcd__change(const nsvcd__planner *p, const nsvcd__stage *stage,
                          const float *control, const float *offset, float scale, float *out) {
  const size_t f = p->in->joints;
  memcpy(out, control, stage->bytes);
  for (size_t k = 0; k < stage->numbers; k++) {
    const float x = control[f + k] + scale * offset[k];
    const float low = p->in->low[k % f];
    const float high = p->in->high[k % f];
    // NaN becomes `high`
    out[f + k] = x < low ? low : x < high ? x : high;
  }
}

// Counts an iteration, and reports to the caller, who may cancel the search.
static void nsvcd__report(nsvcd__planner *p, size_t iteration, const nsvcd__stage *stage,
                          const nsvcd__cost *best) {
  const int refining = stage == &p->refine;
  const nsvcd_plan_progress progress = {p->answer.seeds, iteration,   stage->iterations,
                                        refining,        best->total, best->collision,
                                        p->best,         stage->via};
  p->answer.iterations++;
  if (p->in->progress) p->cancelled = p->in->progress(p->in->user, &progress);
}

// Where MPPI is.
typedef struct nsvcd__exploring {
  float deviations[NSVCD_MAX_JOINTS];  // of the rollouts
  float temperature;                   // 0 at first
  float least;                         // cost of the last rollouts
  nsvcd__cost best;                    // of all
} nsvcd__exploring;

// Draws rollouts about p->control, and finds their costs; the best of all goes to p->best. The
// first has no offset, the second is the best so far, the others are noise.
static void nsvcd__roll_out(nsvcd__planner *p, nsvcd__exploring *at) {
  const nsvcd__stage *stage = &p->explore;
  const size_t f = p->in->joints;
  at->least = INFINITY;
  for (size_t n = 0; n < stage->draws; n++) {
    float *offset = p->drawn + n * stage->numbers;
    if (n > 0) nsvcd__smooth_noise(p, stage, at->deviations, offset);
    for (size_t k = 0; n < 2 && k < stage->numbers; k++)
      offset[k] = n > 0 ? p->best[f + k] - p->control[f + k] : 0;
    nsvcd__change(p, stage, p->control, offset, 1, p->trial);
    for (size_t k = 0; k < stage->numbers; k++)
      offset[k] = p->trial[f + k] - p->control[f + k];

    // The cost of a rollout that weighs nothing need not be exact.
    float limit = INFINITY;
    if (at->temperature > 0) limit = at->least + NSVCD__WEIGHTLESS * at->temperature;
    const nsvcd__cost cost = nsvcd__cost_of(p, stage, p->trial, limit, NULL);
    p->costs[n] = cost.total;
    if (cost.total < at->least) at->least = cost.total;
    if (cost.total >= at->best.total || cost.total > limit) continue;
    at->best = cost;
    memcpy(p->best, p->trial, stage->bytes);
  }
}

// Turns p->costs into weights, whose sum is 1; writes the mean of the offsets to p->sum; moves the
// variances a tenth of the way to twice those of the weighted rollouts about that mean.
static void nsvcd__weigh_rollouts(nsvcd__planner *p, nsvcd__exploring *at) {
  const nsvcd__stage *stage = &p->explore;
  const size_t f = p->in->joints;
  const size_t draws = stage->draws;
  const size_t rank = draws / NSVCD__ELITE;
  float elite = 0;  // the cost of that rank
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
    const float least = 1e-3f * p->first_noise[j] * p->first_noise[j];
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

// MPPI, from the mean p->control on. Leaves the best trajectory in p->best.
static void nsvcd__explore(nsvcd__planner *p) {
  const nsvcd__stage *stage = &p->explore;
  nsvcd__exploring at;
  memset(&at, 0, sizeof at);
  at.best = nsvcd__cost_of(p, stage, p->control, INFINITY, NULL);
  memcpy(p->best, p->control, stage->bytes);
  memcpy(at.deviations, p->first_noise, sizeof at.deviations);
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
// In: control points. Out: better ones, by L-BFGS (Liu and Nocedal 1989) with bundled gradients
// (Suh et al. 2022).
//
// Difference from Liu and Nocedal: the initial inverse Hessian is half the inverse of the
// smoothness' form, not a multiple of the identity. It is exact where nothing collides.

#ifndef NSVCD_NO_OPTIMIZER
static double nsvcd__dot(const float *a, const float *b, size_t count) {
  double sum = 0;
  for (size_t k = 0; k < count; k++) sum += (double)a[k] * (double)b[k];
  return sum;
}

// p->sum (M, F): the mean of the gradients at `control` + each offset of the bundle p->drawn.
static void nsvcd__bundled_gradient(nsvcd__planner *p, const nsvcd__stage *stage,
                                    const float *control) {
  const size_t f = p->in->joints;
  memset(p->sum, 0, stage->numbers * sizeof *p->sum);
  for (size_t n = 0; n < stage->draws && !p->error; n++) {
    nsvcd__change(p, stage, control, p->drawn + n * stage->numbers, 1, p->trial);
    nsvcd__cost_of(p, stage, p->trial, INFINITY, p->gradient);
    for (size_t k = 0; k < stage->numbers; k++)
      p->sum[k] += p->gradient[f + k] / (float)stage->draws;
  }
}

// The n-th step, or the n-th change of the gradient; the last HISTORY are kept.
static float *nsvcd__remembered(float *rows, size_t n, const nsvcd__stage *stage) {
  return rows + n % NSVCD__HISTORY * stage->numbers;
}

// p->offset (M, F): L-BFGS's direction for the gradient p->sum, by its two loops over the `kept`
// steps before step `next`.
static void nsvcd__direction(nsvcd__planner *p, const nsvcd__stage *stage, size_t kept,
                             size_t next) {
  const size_t numbers = stage->numbers;
  const size_t f = p->in->joints;
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

// L-BFGS, from p->best on, which it improves. Ends early if the cost does not fall even along the
// direction that remembers no step.
static void nsvcd__refine(nsvcd__planner *p) {
  static const float lengths[NSVCD__STEPS] = {1, 0.5f, 0.2f, 0.05f, 0.01f};
  const nsvcd__stage *stage = &p->refine;
  const size_t f = p->in->joints;
  const size_t numbers = stage->numbers;
  float deviations[NSVCD_MAX_JOINTS];
  size_t kept = 0;  // steps, before step `next`
  size_t next = 0;
  int stuck = 0;
  nsvcd__cost best = nsvcd__cost_of(p, stage, p->best, INFINITY, NULL);

  // The same offsets in each iteration: then gradients differ only by where they are taken.
  for (size_t j = 0; j < f; j++) deviations[j] = stage->noise;
  for (size_t n = 0; n < stage->draws; n++)
    nsvcd__smooth_noise(p, stage, deviations, p->drawn + n * numbers);

  for (size_t i = 0; i < stage->iterations && !stuck && !p->cancelled && !p->error; i++) {
    const float before = best.total;
    memcpy(p->control, p->best, stage->bytes);
    nsvcd__bundled_gradient(p, stage, p->control);
    if (kept > 0) {
      // `change` holds minus the gradient before the last step. The step is forgotten if the
      // gradient does not grow along it: the inverse Hessian stays positive definite.
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
      const nsvcd__cost cost = nsvcd__cost_of(p, stage, p->trial, best.total, NULL);
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
// In: a planning problem. Out: control points of a motion that hits nothing, by the last check, or
// of the best that was found.

#ifndef NSVCD_NO_OPTIMIZER
// The smoothest control points from start to goal, (M + 2, F): where the form's derivative is zero.
static void nsvcd__smoothest(nsvcd__planner *p, const nsvcd__stage *stage, float *control) {
  const size_t f = p->in->joints;
  const size_t via = stage->via;
  const size_t all = via + 2;
  for (size_t j = 0; j < f; j++) {
    const double start = (double)p->in->start[j];
    const double goal = (double)p->in->goal[j];
    for (size_t k = 0; k < via; k++) {
      const double *row = stage->form + (k + 1) * all;
      p->vector[k] = -row[0] * start - row[all - 1] * goal;
    }
    nsvcd__solve_lower(stage->factor, via, p->vector);
    nsvcd__solve_upper(stage->factor, via, p->vector);
    for (size_t k = 0; k < via; k++) control[(k + 1) * f + j] = (float)p->vector[k];
  }
  memcpy(control, p->in->start, f * sizeof *control);
  memcpy(control + (via + 1) * f, p->in->goal, f * sizeof *control);
}

// Are the joints within the limits, and free of collision? Leaves what is wrong in p->cost.
static int nsvcd__is_good(nsvcd__planner *p, const float *joints) {
  nsvcd__cost *cost = &p->cost;
  *cost = nsvcd__no_cost;
  for (size_t j = 0; j < p->in->joints; j++) {
    if (joints[j] < p->in->low[j] || joints[j] > p->in->high[j]) cost->joint = j;
  }
  if (cost->joint != NSVCD_NONE) {
    cost->logit = 0;
    return 0;
  }
  nsvcd__find_poses(p, joints, 1, p->poses);
  if (p->error) return 0;
  nsvcd__add_collision(p, 1, INFINITY, NULL, 1, cost);
  return !cost->collides;
}

NSVCDDEF size_t nsvcd_plan_workspace_size(const nsvcd_plan_problem *problem,
                                          const nsvcd_plan_options *options) {
  nsvcd__planner planner;
  if (nsvcd__planner_settings(problem, options, &planner)) return 0;
  return nsvcd__planner_memory(&planner, NULL);
}

// Fills in what is computed once, when the memory is laid out.
static void nsvcd__planner_begin(nsvcd__planner *p) {
  nsvcd__stage_init(&p->options, &p->explore);
  nsvcd__stage_init(&p->options, &p->refine);
  nsvcd__stage_init(&p->options, &p->check);
  nsvcd__find_shapes(p);
  for (size_t k = 0; k < p->in->pair_count; k++) p->queue[k] = (uint32_t)k;
  for (size_t j = 0; j < p->in->joints; j++) {
    const float quarter = 0.25f * (p->in->high[j] - p->in->low[j]);
    p->first_noise[j] = p->explore.noise < quarter ? p->explore.noise : quarter;
  }
  p->random = p->options.seed;
}

// How far, at most, a point of a's bounding sphere is from where the last check has it, as b sees
// it. The check's motion is at a share `fraction` of the way from the poses `from` (B) to the next
// ones; the spline has its poses in p->moved.
static float nsvcd__pair_deviation(const nsvcd__planner *p, const nsvcd_body_pair *pair,
                                   const nsvcd_pose *from, double fraction) {
  const nsvcd_pose *to = from + p->in->body_count;
  const nsvcd__sphere *sphere = &p->shapes[pair->a].sphere;
  const nsvcd_pose start = nsvcd__relative_pose(&from[pair->a], &from[pair->b]);
  const nsvcd_pose end = nsvcd__relative_pose(&to[pair->a], &to[pair->b]);
  const nsvcd_pose spline = nsvcd__relative_pose(&p->moved[pair->a], &p->moved[pair->b]);
  const nsvcd__d3 pivot = nsvcd__d3_of(0, 0, 0);
  const nsvcd__world_pose check = nsvcd__world_pose_between(&start, &end, pivot, fraction);
  const nsvcd__quat q = nsvcd__quat_load(spline.rotation);
  const nsvcd__transform at = {nsvcd__mat3_of(q), nsvcd__f3_load(spline.position)};
  const nsvcd__transform checked = {nsvcd__mat3_of(check.rotation),
                                    nsvcd__d3_narrow(check.position)};
  const nsvcd__f3 x = nsvcd__f3_transform(&at, sphere->centre);
  const nsvcd__f3 y = nsvcd__f3_transform(&checked, sphere->centre);
  const float shift = nsvcd__f3_norm(nsvcd__f3_sub(x, y));
  return shift + 2 * nsvcd__f3_norm(nsvcd__quat_turn(check.rotation, q)) * sphere->radius;
}

// How far the spline deviates from the last check's motion between p->poses: the most of all pairs
// whose a is given. Measured, not bounded: nothing is known of `kinematics` but its values. A
// smooth curve deviates most half way between two poses, and is sampled there, in every stride-th
// segment. If segments are few, each is sampled more often, for an S crosses its chord half way.
static float nsvcd__plan_deviation(nsvcd__planner *p, const float *control) {
  const size_t segments = p->check.moments - 1;
  const size_t wanted = NSVCD__DEVIATION_SAMPLES * (p->check.via + 1);
  const size_t stride = wanted < segments ? segments / wanted : 1;
  const size_t samples = 2 * (wanted / segments) + 1;  // of a segment
  float joints[NSVCD_MAX_JOINTS];
  float most = 0;
  for (size_t n = 0; p->in->bodies && n / samples * stride < segments; n++) {
    const size_t s = n / samples * stride;
    const double fraction = (double)(n % samples + 1) / (double)(samples + 1);
    const double t = ((double)s + fraction) / (double)segments;
    nsvcd_spline(control, p->check.via, p->in->joints, (float)t, 0, joints);
    nsvcd__find_poses(p, joints, 1, p->moved);
    if (p->error) break;
    for (size_t k = 0; k < p->in->pair_count; k++) {
      const nsvcd_body_pair *pair = &p->in->pairs[k];
      const nsvcd_pose *from = p->poses + s * p->in->body_count;
      if (p->in->bodies[pair->a])
        most = fmaxf(nsvcd__pair_deviation(p, pair, from, fraction), most);
    }
  }
  return most;
}

// Searches from one more start. Keeps what it finds in p->result if that is the best so far.
// Returns whether to try another.
static int nsvcd__try_seed(nsvcd__planner *p) {
  const size_t f = p->in->joints;
  const float margin = p->options.margin;
  nsvcd_plan_answer *answer = &p->answer;
  nsvcd__cost cost = nsvcd__no_cost;
  // from the smoothest trajectory, then from random changes of it
  nsvcd__smoothest(p, &p->explore, p->control);
  if (answer->seeds > 0) {
    nsvcd__smooth_noise(p, &p->explore, p->first_noise, p->offset);
    nsvcd__change(p, &p->explore, p->control, p->offset, 1, p->trial);
    memcpy(p->control, p->trial, p->explore.bytes);
  }
  nsvcd__explore(p);

  // Nearly the same curve through another number of via points; these are clamped to the limits,
  // which a curve may leave between two points.
  if (p->explore.via != p->refine.via) {
    for (size_t k = 0; k < p->refine.via + 2; k++) {
      const float t = (float)k / (float)(p->refine.via + 1);
      nsvcd_spline(p->best, p->explore.via, f, t, 0, p->trial + k * f);
    }
    nsvcd__change(p, &p->refine, p->trial, p->trial, 0, p->best);
  }

  // until the last check finds it free, with a wider margin after each hit that is proven
  for (size_t retry = 0; retry <= NSVCD__RETRIES; retry++) {
    nsvcd__refine(p);
    cost = nsvcd__cost_of(p, &p->check, p->best, INFINITY, NULL);
    if (nsvcd__is_free(&cost) || p->cancelled || p->error || !cost.proven) break;
    p->options.margin = 2 * p->options.margin + 0.5f;
  }
  p->options.margin = margin;
  const int good = nsvcd__is_free(&cost);
  if (answer->seeds == 0 || good || cost.total < p->cost.total) {
    memcpy(p->result, p->best, p->refine.bytes);
    p->cost = cost;
    answer->deviation = nsvcd__plan_deviation(p, p->result);
  }
  answer->seeds++;
  answer->status = NSVCD_PLAN_LIMIT;
  if (good) answer->status = NSVCD_PLAN_CONVERGED;
  if (p->cancelled) answer->status = NSVCD_PLAN_CANCELLED;
  return !good && !p->cancelled && !p->error && answer->seeds < p->options.seeds;
}

NSVCDDEF nsvcd_result nsvcd_plan(const nsvcd_plan_problem *problem,
                                 const nsvcd_plan_options *options, void *workspace,
                                 size_t workspace_size, float *control,
                                 nsvcd_plan_answer *answer) {
  nsvcd__planner p;
  const nsvcd_result error = nsvcd__planner_settings(problem, options, &p);
  if (error) return error;
  if (!control || !answer) return NSVCD_ERROR_ARGUMENT;
  const size_t needed = nsvcd__planner_memory(&p, NULL);
  if (needed == 0) return NSVCD_ERROR_TOO_LARGE;
  if (!workspace || !nsvcd__is_aligned(workspace) || workspace_size < needed)
    return NSVCD_ERROR_WORKSPACE;
  for (size_t j = 0; j < problem->joints; j++) {
    const float ends[4] = {problem->low[j], problem->high[j], problem->start[j],
                           problem->goal[j]};
    if (!nsvcd__in_range(ends, 4, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_VALUE;
    if (ends[0] > ends[1]) return NSVCD_ERROR_LIMITS;
  }

  (void)nsvcd__planner_memory(&p, (char *)workspace);
  nsvcd__planner_begin(&p);
  nsvcd_plan_answer *out = &p.answer;
  if (!nsvcd__is_good(&p, problem->start)) {
    out->status = NSVCD_PLAN_START;
  } else if (!nsvcd__is_good(&p, problem->goal)) {
    out->status = NSVCD_PLAN_GOAL;
    p.cost.time = 1;
  }
  nsvcd__smoothest(&p, &p.refine, p.best);
  int more = out->status == NSVCD_PLAN_CONVERGED && !p.error;
  while (more) more = nsvcd__try_seed(&p);
  if (p.error) return p.error;

  memcpy(control, out->seeds ? p.result : p.best, p.refine.bytes);
  out->via_points = p.refine.via;
  out->cost = p.cost.total;
  out->smoothness = p.cost.smoothness;
  out->collides = p.cost.collides;
  out->joint = p.cost.joint;
  out->logit = p.cost.logit;
  out->time = p.cost.time;
  out->pair = p.cost.pair;
  *answer = *out;
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
