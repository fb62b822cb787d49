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
// CONTENTS: a room's name ends a line of dashes. Each uses only those above it.
//   interface: what a program sees
//     certificates    a mesh's tree; a proof as bytes; nsvcd_certify
//   ground: numbers and memory
//     compiler        what is asked of the compiler; libc and libm
//     angles          sines and angles, by libm or computed here
//     bits            bits and sizes
//     digests         digests of words
//     valid           is what a caller hands over in order?
//     points          vectors of three, of floats and of doubles
//     rotations       quaternions and matrices, of floats and of doubles
//     motions         between two poses: lines and slerps, in double
//     triangles       two triangles: where they meet, or are nearest
//     spheres         spheres and slabs, as bodies store them
//     random          random numbers
//     memory          the allocator; the rows of a workspace
//   certificate: a proof that others can check
//     tree            boxes over triangles, connected components
//     models          where a body is, how far points leave their chords
//     planes          a plane that separates two nodes for an interval of time
//     rays            what a ray crosses
//     traversal       the traversal, and its bits
//     certify         what is inside; answers
//
// GLOSSARY
//   tree, node   boxes over a mesh's triangles; one of them, and its run of triangles
//   certificate  bytes that prove an answer: a traversal of two trees and of time, and rays
#ifndef NEURALSVCD_CERTIFY_H
#define NEURALSVCD_CERTIFY_H
#ifndef NEURALSVCD_H  // include it first where it stands elsewhere
#include "../neuralsvcd.h"
#endif

// ================================================================== interface: what a program sees
#ifdef __cplusplus
extern "C" {
#endif

// -------------------------------------------------------------------------- interface/certificates
// In: a question, and its two meshes. Out: bytes that prove the answer. Anyone who has the meshes
// can check them with examples/verify, which shares nothing with this library.

// A tree of boxes over the triangles of a mesh, in the caller's memory, for nsvcd_certify. It keeps
// pointers to the mesh's arrays, which must not change. Threads may share it.
typedef struct nsvcd_tree nsvcd_tree;

// Bytes that nsvcd_tree_build needs, about 88 for a triangle and 9 for a vertex; 0 if the mesh is
// refused.
//   mesh       may be NULL
NSVCDDEF size_t nsvcd_tree_size(const nsvcd_mesh *mesh);

// Builds the tree of a mesh, which takes about as long as sorting its triangles.
//   mesh       not NULL; its arrays are kept
//   memory     (size) bytes, nsvcd_tree_size(mesh) or more, not NULL, aligned to NSVCD_ALIGNMENT;
//              the tree is in it
//   tree       not NULL; set to the tree, or left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, INDEX, NUMBER, EMPTY, TOO_LARGE, WORKSPACE
NSVCDDEF nsvcd_result nsvcd_tree_build(const nsvcd_mesh *mesh, void *memory, size_t size,
                                       const nsvcd_tree **tree);

// A pose in double. A corner x of the mesh is at position + scale * x turned by `rotation`.
typedef struct nsvcd_pose64 {
  double position[3];  // metres
  double rotation[4];  // quaternion x y z w, of any length but 0
} nsvcd_pose64;

// A bound of how far a point leaves the chord between its positions at two times, in metres along a
// unit direction n: base + per_metre r + turn rho |n x R axis|. The point is r metres from the
// mesh's origin, and rho metres from the line through the origin along the axis.
typedef struct nsvcd_deviation {
  double base, per_metre, turn;
  // a unit vector of the mesh's frame that the rotation R takes to the same vector at all times in
  // between; or 0, with `turn` 0
  double axis[3];
} nsvcd_deviation;

// How a mesh moves, for nsvcd_certify_models, with t in [0,1]. A keyframe is a time at which the
// motion may have a corner. The proof relies on what the functions return.
typedef struct nsvcd_motion_model {
  // scale of the mesh about its origin
  double scale;
  // the pose at a time
  nsvcd_pose64 (*pose_at)(const void *motion, double t);
  // the next keyframe after a time before 1
  double (*next)(const void *motion, double t);
  // the deviation of the mesh's points from t0 to t1, between which there is no keyframe
  nsvcd_deviation (*deviation)(const void *motion, double t0, double t1);
  const void *motion;  // handed to these functions
  double extent;       // metres: a bound of the lengths that its positions are computed from
  uint32_t digest;     // digest of the scale and the motion, as a checker computes it
} nsvcd_motion_model;

#define NSVCD_DEFAULT_VISITS 1000000

// How an answer is certified. Zero means the default.
typedef struct nsvcd_certify_options {
  // the answer of nsvcd_sweep, as a hint where a hit is; may be NULL. One thing is believed of it:
  // if it says that something is, or may be, inside a mesh that is not closed, no certificate says
  // FREE
  const nsvcd_answer *answer;
  // the most visits of the traversal, each to two boxes over an interval of time; default
  // NSVCD_DEFAULT_VISITS
  size_t visits;
} nsvcd_certify_options;

// What was proven.
typedef struct nsvcd_certificate {
  // FREE and HIT: the bytes prove it. UNDECIDED: there are no bytes
  nsvcd_verdict verdict;
  // the reason if it is UNDECIDED. WORK: the visits were not enough. TOO_NEAR: surfaces touch, or
  // come too near to tell; or none of 64 rays was clear. OPEN: options.answer says that something
  // is, or may be, inside a mesh that is not closed. Closed is meant as examples/verify has it:
  // each edge must have its reverse, and no flaw is mended
  nsvcd_why why;
  // 1: a HIT because a corner of one mesh is inside the other
  int inside;
  // time in [0,1] of the contact that is proven, of a HIT; it need not be the first
  double time;
  // bytes of the certificate, also if there was no room for all
  size_t size;
  // number of visits that the traversal took
  size_t visits;
} nsvcd_certificate;

// Bytes of workspace that nsvcd_certify needs: some 300 for each pose of either mesh, and 4 for
// each vertex of the mesh that has more; 0 if the question is refused.
//   question   not NULL
//   a, b       trees of the meshes of question->a and question->b, not NULL
NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b);

// Proves the answer to a question anew, and writes the proof. It shares two things with
// nsvcd_sweep, both of which are checked: where a body is between two poses, and how the nearest
// points of two triangles are found.
//
// FREE: the two surfaces never come within the clearance, and neither mesh is inside the other.
// HIT: at the certificate's time an edge passes through a triangle, or points are nearer than the
// clearance, or a corner is inside. Surfaces are UNDECIDED as well if they only touch, with no edge
// through a triangle, or come nearer than 1e-10 of all lengths (extents, and positions in the
// world).
//   question   not NULL. Its poses, times, scales and clearance are used; its bodies are not, and
//              may be NULL
//   a, b       trees of the meshes of question->a and question->b, not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_certify_workspace_size(question, a, b) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   bytes      (capacity): the certificate, as far as there is room; NULL if capacity is 0. Free
//              motions take 40 to 300 bytes in the median, 2,000 in the mean and 90,000 at most
//   made       not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; trees may be shared
//   errors     ARGUMENT, SLOP and PIVOT (if there is one), SCALE, POSES, TIMES, POSE, QUATERNION,
//              CLEARANCE, WORKSPACE
//   source     this library; examples/verify/nsvcd_verify.h describes the traversal. Planes by
//              Gilbert 1966
NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made);

// Bytes of workspace that nsvcd_certify_models needs; 0 if they are more than SIZE_MAX.
//   keyframes  number of keyframes of both models, with 0 and 1
//   a, b       trees of the meshes, not NULL
NSVCDDEF size_t nsvcd_certify_models_workspace_size(size_t keyframes, const nsvcd_tree *a,
                                                    const nsvcd_tree *b);

// Proves whether two meshes meet in any two motions, and writes the proof, as nsvcd_certify does.
// neuralsvcd_robot.h has the motions of a robot's joints: nsvcd_certify_pair.
//   models     (2) motions of the meshes of a and b, not NULL
//   keyframes  number of keyframes of both models, with 0 and 1. If there are more, the answer is
//              UNDECIDED
//   clearance  metres
//   a, b, options, bytes, made   as for nsvcd_certify
//   workspace  (workspace_size) bytes, nsvcd_certify_models_workspace_size(keyframes, a, b) or
//              more, not NULL, aligned to NSVCD_ALIGNMENT
//   allocates  nothing
//   threads    each needs a workspace of its own; trees may be shared
//   errors     ARGUMENT, CLEARANCE, WORKSPACE
//   source     this library
NSVCDDEF nsvcd_result nsvcd_certify_models(
    const nsvcd_motion_model *models, size_t keyframes, float clearance, const nsvcd_tree *a,
    const nsvcd_tree *b, const nsvcd_certify_options *options, void *workspace,
    size_t workspace_size, uint8_t *bytes, size_t capacity, nsvcd_certificate *made);
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

// ---------------------------------------------------------------------------------- ground/digests
#ifndef NSVCD__HAS_GROUND_DIGESTS
#define NSVCD__HAS_GROUND_DIGESTS
// In: words of 32 bits. Out: a digest of them.

// Continues a digest over (count) words of 32 bits.
static uint32_t nsvcd__digest(uint32_t digest, const void *words, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint32_t word;
    memcpy(&word, (const char *)words + 4 * i, 4);
    digest = (digest ^ word) * 0x9e3779b1u;
    digest ^= digest >> 15;
  }
  return digest;
}
#endif  // NSVCD__HAS_GROUND_DIGESTS

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

// The normal of a triangle (3 corners); its length is twice the area. Of a segment (a, b, b), as
// round bodies have it, it is 0 where products are fused with sums, too: there a vector across
// itself is what a product was rounded by.
static nsvcd__d3 nsvcd__face_normal(const nsvcd__d3 *t) {
  const nsvcd__d3 u = nsvcd__d3_sub(t[1], t[0]);
  const nsvcd__d3 v = nsvcd__d3_sub(t[2], t[0]);
  const int are_one =
      !(u.x < v.x || u.x > v.x || u.y < v.y || u.y > v.y || u.z < v.z || u.z > v.z);
  return are_one ? nsvcd__d3_of(0, 0, 0) : nsvcd__d3_cross(u, v);
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

// ===================================================== certificate: a proof that others can check

// -------------------------------------------------------------------------------- certificate/tree
// In: a mesh. Out: its connected components, and a tree of boxes over its triangles. The floor, top
// to bottom:
//
//   tree        boxes, and components
//   models      where a body is at a time, and how far points leave their chords
//   planes      a plane that separates two nodes for an interval of time; its normal in a few bits
//   rays        what is inside of what at one time
//   certify     the traversal that a certificate is
//
// examples/verify builds and computes all of this again, by code of its own. The rules by which
// nodes are cut and opened, and the form of the bits, are the same in both.

// of a mesh, at most; and nodes on the stack of a traversal of that many
#define NSVCD__TREE_TRIANGLES 0x20000000
#define NSVCD__TREE_STACK 32

// A run of triangles of a tree, with a box about them.
typedef struct nsvcd__node {
  // its row of boxes
  uint32_t box;
  // of order
  uint32_t first, count;
} nsvcd__node;

struct nsvcd_tree {
  nsvcd_mesh mesh;
  // (2 triangles - 1): of a node, of its left tree, of its right tree
  nsvcd__box *boxes;
  // (triangles): the leaves, from left to right
  uint32_t *order;
  // (triangles, 3, 3), in that order
  float *corners;
  // (vertices): the lowest vertex of its component; NSVCD_NO_TRIANGLE: no triangle has it
  uint32_t *component;
  // (vertices): the lowest vertex at its position
  uint32_t *weld;
  // (vertices): 1: that vertex's component is not closed
  uint8_t *open;
  uint32_t digest;
};

static const float *nsvcd__tree_corner(const nsvcd_tree *tree, uint32_t triangle, uint32_t k) {
  const uint32_t vertex = tree->mesh.indices[3 * (size_t)triangle + k];
  return tree->mesh.positions + 3 * (size_t)vertex;
}

// Three times a triangle's middle, in double: a key to sort by, which must be the same each time.
static nsvcd__d3 nsvcd__tree_middle(const nsvcd_tree *tree, uint32_t triangle) {
  nsvcd__d3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < 3; k++) {
    const nsvcd__d3 corner = nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, k));
    sum = nsvcd__d3_stored(nsvcd__d3_add(sum, corner));
  }
  return sum;
}

// Below 0: a triangle is before another one, whose key is given; above 0: it is after it.
static int nsvcd__tree_order(const nsvcd_tree *tree, uint32_t triangle, uint32_t other,
                             double key, size_t axis) {
  const double own = nsvcd__d3_axis(nsvcd__tree_middle(tree, triangle), axis);
  if (own < key || own > key) return own < key ? -1 : 1;
  return triangle < other ? -1 : triangle > other;
}

// Sets the box of a node, and puts the lower half of its triangles first: by their middles, along
// the axis along which these differ most, and of equals by number. Quickselect (Hoare 1961).
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
    for (uint32_t k = 0; k < 3; k++) {
      const nsvcd__f3 x = nsvcd__f3_load(nsvcd__tree_corner(tree, order[i], k));
      box.low = nsvcd__f3_min(box.low, x);
      box.high = nsvcd__f3_max(box.high, x);
    }
  }
  tree->boxes[node->box] = box;
  const nsvcd__d3 sides = nsvcd__d3_stored(nsvcd__d3_sub(most, least));
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

// ---- components

// Below 0, 0 or above it: the position of vertex i is before, at or after that of vertex j.
static int nsvcd__position_order(const nsvcd_tree *tree, uint32_t i, uint32_t j) {
  const float *x = tree->mesh.positions + 3 * (size_t)i;
  const float *y = tree->mesh.positions + 3 * (size_t)j;
  for (size_t k = 0; k < 3; k++) {
    if (x[k] < y[k]) return -1;
    if (x[k] > y[k]) return 1;
  }
  return 0;
}

// The ends of an edge, by the lowest vertices at their positions. Edge 3 t + k begins at corner k
// of triangle t.
static void nsvcd__edge_ends(const nsvcd_tree *tree, uint32_t edge, uint32_t *ends) {
  const uint32_t next = edge % 3 == 2 ? edge - 2 : edge + 1;
  ends[0] = tree->weld[tree->mesh.indices[edge]];
  ends[1] = tree->weld[tree->mesh.indices[next]];
}

// The same order of two edges, whichever way they go.
static int nsvcd__edge_order(const nsvcd_tree *tree, uint32_t i, uint32_t j) {
  uint32_t a[2], b[2];
  nsvcd__edge_ends(tree, i, a);
  nsvcd__edge_ends(tree, j, b);
  const int up_a = a[0] < a[1];
  const int up_b = b[0] < b[1];
  const uint64_t x = (uint64_t)a[!up_a] << 32 | a[up_a];
  const uint64_t y = (uint64_t)b[!up_b] << 32 | b[up_b];
  return x < y ? -1 : x > y;
}

typedef int nsvcd__tree_compare(const nsvcd_tree *tree, uint32_t i, uint32_t j);

// Moves an entry of a heap down to where it belongs.
static void nsvcd__sink(const nsvcd_tree *tree, nsvcd__tree_compare *order, uint32_t *heap,
                        size_t count, size_t at) {
  const uint32_t sinks = heap[at];
  for (size_t child = 2 * at + 1; child < count; child = 2 * at + 1) {
    if (child + 1 < count && order(tree, heap[child], heap[child + 1]) < 0) child++;
    if (order(tree, sinks, heap[child]) >= 0) break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = sinks;
}

// Heap sort (Williams 1964): no memory, and no mesh makes it slow.
static void nsvcd__sort_numbers(const nsvcd_tree *tree, nsvcd__tree_compare *order,
                                uint32_t *numbers, size_t count) {
  for (size_t at = count / 2; at-- > 0;) nsvcd__sink(tree, order, numbers, count, at);
  for (size_t end = count; end-- > 1;) {
    const uint32_t last = numbers[end];
    numbers[end] = numbers[0];
    numbers[0] = last;
    nsvcd__sink(tree, order, numbers, end, 0);
  }
}

// Fills in tree->weld. numbers: (vertices), scratch.
static void nsvcd__weld_positions(nsvcd_tree *tree, uint32_t *numbers) {
  const size_t count = tree->mesh.vertex_count;
  size_t end;
  for (size_t v = 0; v < count; v++) numbers[v] = (uint32_t)v;
  nsvcd__sort_numbers(tree, nsvcd__position_order, numbers, count);
  for (size_t i = 0; i < count; i = end) {
    uint32_t lowest = numbers[i];
    end = i;
    while (end < count && nsvcd__position_order(tree, numbers[i], numbers[end]) == 0) {
      lowest = numbers[end] < lowest ? numbers[end] : lowest;
      end++;
    }
    for (size_t n = i; n < end; n++) tree->weld[numbers[n]] = lowest;
  }
}

// Union-find, with the lowest vertex as the root.
static uint32_t nsvcd__find_root(uint32_t *roots, uint32_t v) {
  while (roots[v] != v) {
    roots[v] = roots[roots[v]];
    v = roots[v];
  }
  return v;
}

static void nsvcd__unite(uint32_t *roots, uint32_t v, uint32_t w) {
  const uint32_t x = nsvcd__find_root(roots, v);
  const uint32_t y = nsvcd__find_root(roots, w);
  roots[x > y ? x : y] = x > y ? y : x;
}

// Fills in tree->component and tree->open: unites the corners of each triangle, and vertices at the
// same position. A component is open if its triangles do not go along an edge equally often in both
// directions. edges: (3 triangles), scratch.
static void nsvcd__find_components(nsvcd_tree *tree, uint32_t *edges) {
  const uint32_t *indices = tree->mesh.indices;
  const size_t corners = 3 * tree->mesh.triangle_count;
  size_t end;
  uint32_t *roots = tree->component;
  nsvcd__weld_positions(tree, roots);
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) {
    roots[v] = NSVCD_NO_TRIANGLE;
    tree->open[v] = 0;
  }
  for (size_t i = 0; i < corners; i++) {
    const uint32_t lowest = tree->weld[indices[i]];
    roots[indices[i]] = indices[i];
    roots[lowest] = lowest;
    edges[i] = (uint32_t)i;
  }
  for (size_t i = 0; i < corners; i++) {
    nsvcd__unite(roots, indices[i], indices[i / 3 * 3]);
    nsvcd__unite(roots, indices[i], tree->weld[indices[i]]);
  }
  for (size_t i = 0; i < corners; i++) roots[indices[i]] = nsvcd__find_root(roots, indices[i]);
  nsvcd__sort_numbers(tree, nsvcd__edge_order, edges, corners);
  for (size_t i = 0; i < corners; i = end) {
    ptrdiff_t balance = 0;
    for (end = i; end < corners && nsvcd__edge_order(tree, edges[i], edges[end]) == 0; end++) {
      uint32_t ends[2];
      nsvcd__edge_ends(tree, edges[end], ends);
      balance += (ends[0] < ends[1]) - (ends[1] < ends[0]);
    }
    if (balance != 0) tree->open[roots[indices[edges[i]]]] = 1;
  }
}

// Lays a tree out at base, or, where that is NULL, only counts. Returns the bytes that it takes.
static uint64_t nsvcd__tree_layout(const nsvcd_mesh *mesh, char *base, nsvcd_tree *tree) {
  uint64_t used = 0;
  const size_t triangles = mesh->triangle_count;
  (void)nsvcd__take(base, &used, 1, sizeof *tree);
  tree->boxes = NSVCD__TAKE_ROWS(nsvcd__box, 2 * triangles - 1, base, &used);
  tree->order = NSVCD__TAKE_ROWS(uint32_t, triangles, base, &used);
  tree->corners = (float *)nsvcd__take(base, &used, triangles, 9 * sizeof(float));
  tree->component = NSVCD__TAKE_ROWS(uint32_t, mesh->vertex_count, base, &used);
  tree->weld = NSVCD__TAKE_ROWS(uint32_t, mesh->vertex_count, base, &used);
  tree->open = NSVCD__TAKE_ROWS(uint8_t, mesh->vertex_count, base, &used);
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
  nsvcd_tree counted;
  size_t height = 1;
  const nsvcd_result result = nsvcd__mesh_check(mesh);
  if (result) return result;
  if (!tree) return NSVCD_ERROR_ARGUMENT;
  const uint64_t needed = nsvcd__tree_layout(mesh, NULL, &counted);
  if (mesh->triangle_count > NSVCD__TREE_TRIANGLES || needed > SIZE_MAX)
    return NSVCD_ERROR_TOO_LARGE;
  if (!memory || size < needed || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_tree *t = (nsvcd_tree *)memory;
  (void)nsvcd__tree_layout(mesh, (char *)memory, t);
  t->mesh = *mesh;
  t->digest =
      nsvcd__digest((uint32_t)mesh->vertex_count, mesh->positions, 3 * mesh->vertex_count);
  t->digest = nsvcd__digest(t->digest, mesh->indices, 3 * mesh->triangle_count);
  nsvcd__find_components(t, (uint32_t *)t->boxes);
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
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    const float *corner = nsvcd__tree_corner(t, t->order[i / 3], (uint32_t)(i % 3));
    memcpy(t->corners + 3 * i, corner, 3 * sizeof *corner);
  }
  *tree = t;
  return NSVCD_OK;
}

// ------------------------------------------------------------------------------ certificate/models
// In: a mesh that moves. Out: where it is at a time, and how far points leave the chords between
// their positions at two times. With the proof it shares the law of motion, ground/motions, and
// nothing else: a certificate is a second opinion, and its checker has a law of its own.

// A mesh that moves.
typedef struct nsvcd__moving {
  const nsvcd_tree *tree;
  nsvcd_motion_model model;
} nsvcd__moving;

// Where it is at a time: takes a corner x to rotation (scale x) + position.
static nsvcd__dtransform nsvcd__transform_at(const nsvcd__moving *moving, double t) {
  const nsvcd_pose64 at = moving->model.pose_at(moving->model.motion, t);
  const double *q = at.rotation;
  const nsvcd__dpose pose = {{q[0], q[1], q[2], q[3]},
                             {at.position[0], at.position[1], at.position[2]}};
  return nsvcd__dtransform_of(&pose);
}

// ---- of poses: nsvcd_mover

static double nsvcd__mover_keyframe(const nsvcd_mover *mover, size_t k) {
  if (mover->times) return (double)mover->times[k];
  return nsvcd__stored((double)k / (double)(mover->count - 1));
}

// The pose with which the interval between keyframes begins that a time is in, of a mover of two
// poses or more.
static size_t nsvcd__pose_index(const nsvcd_mover *mover, double t) {
  size_t low = 0;
  size_t high = mover->count - 1;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(nsvcd__mover_keyframe(mover, middle) <= t ? &low : &high) = middle;
  }
  return low;
}

static nsvcd_pose64 nsvcd__mover_pose(const void *motion, double t) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  nsvcd__dpose at = nsvcd__dpose_of(mover->poses);
  if (mover->count > 1) {
    const size_t k = nsvcd__pose_index(mover, t);
    const nsvcd_pose *a = mover->poses + k;
    const double from = nsvcd__mover_keyframe(mover, k);
    const double whole = nsvcd__mover_keyframe(mover, k + 1) - from;
    at = nsvcd__dpose_between(a, a + 1, nsvcd__d3_of(0, 0, 0), (t - from) / whole);
  }
  const nsvcd__dquat q = at.rotation;
  const nsvcd_pose64 out = {{at.position.x, at.position.y, at.position.z},
                            {q.x, q.y, q.z, q.w}};
  return out;
}

static double nsvcd__mover_next(const void *motion, double t) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  return mover->count > 1 ? nsvcd__mover_keyframe(mover, nsvcd__pose_index(mover, t) + 1) : 1;
}

// Along a direction n a turn by h bends by h^2 / 8 (n x a).(a x y): see nsvcd__slerp_turn.
static nsvcd_deviation nsvcd__mover_deviation(const void *motion, double t0, double t1) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  nsvcd_deviation out;
  memset(&out, 0, sizeof out);
  if (mover->count == 1) return out;
  const size_t k = nsvcd__pose_index(mover, 0.5 * (t0 + t1));
  const double begin = nsvcd__mover_keyframe(mover, k);
  const double whole = nsvcd__mover_keyframe(mover, k + 1) - begin;
  nsvcd__slerp arc = nsvcd__slerp_of(mover->poses + k, mover->poses + k + 1);
  arc.fraction = (t1 - t0) / whole;
  const nsvcd__d3 turn = nsvcd__slerp_turn(&arc);
  const nsvcd__dmat3 start = nsvcd__dmat3_of(arc.start);
  const nsvcd__d3 own = nsvcd__dmat3_apply_transpose(&start, turn);
  const nsvcd__d3 axis = nsvcd__d3_unit(own, own);
  memcpy(out.axis, &axis, sizeof out.axis);
  out.turn = 0.1250001 * nsvcd__d3_dot(turn, turn);
  return out;
}

// The model of a mover, of which *meant becomes a copy with the defaults filled in.
static nsvcd_result nsvcd__model_of(const nsvcd_mover *mover, nsvcd_mover *meant,
                                    nsvcd_motion_model *model) {
  const float scale = nsvcd__scale_of(mover);
  *meant = *mover;
  if (!nsvcd__is_finite(mover->scale) || mover->scale < 0) return NSVCD_ERROR_SCALE;
  if (scale < NSVCD_MIN_SCALE || scale > NSVCD_MAX_SCALE) return NSVCD_ERROR_SCALE;
  const nsvcd_result result = nsvcd__track_check(mover);
  if (result) return result;
  for (size_t k = 0; k < 3; k++) {
    if (!(mover->pivot[k] <= 0 && mover->pivot[k] >= 0)) return NSVCD_ERROR_PIVOT;
  }
  if (!mover->poses) {
    meant->poses = &nsvcd__at_origin;
    meant->count = 1;
  }
  if (meant->count == 1) meant->times = NULL;
  model->scale = (double)scale;
  model->pose_at = nsvcd__mover_pose;
  model->next = nsvcd__mover_next;
  model->deviation = nsvcd__mover_deviation;
  model->motion = meant;
  model->extent = 0;
  for (size_t k = 0; k < meant->count; k++) {
    const nsvcd__d3 at = nsvcd__d3_load(meant->poses[k].position);
    model->extent = nsvcd__max(model->extent, fabs(at.x) + fabs(at.y) + fabs(at.z));
  }
  model->digest = nsvcd__digest((uint32_t)meant->count, meant->poses, 7 * meant->count);
  model->digest = nsvcd__digest(model->digest, &scale, 1);
  if (meant->times) model->digest = nsvcd__digest(model->digest, meant->times, meant->count);
  return NSVCD_OK;
}

// ------------------------------------------------------------------------------ certificate/planes
// In: two nodes, and an interval of time. Out: a plane that separates them all the while, by a
// normal that takes a few bits; or none.

// the margin of a separation, as a fraction of all lengths: the checker's, and a little more
#define NSVCD__CERTIFIED_MARGIN 1.01e-10
// nodes of so many triangles are their corners, larger ones their boxes
#define NSVCD__EXACT 24
// of Gilbert's iteration: steps; it ends at this fraction of the best possible distance, and where
// nodes are nearer than that fraction of the first distance
#define NSVCD__GILBERT_STEPS 12
#define NSVCD__GILBERT_ENOUGH 0.8
#define NSVCD__GILBERT_LEAST 1e-3

// Both bodies at a time, and how far points leave their chords to the next instant.
typedef struct nsvcd__instant {
  double t;
  nsvcd__dtransform poses[2];
  // of both positions, and of what they are computed from
  double lengths;
  nsvcd_deviation deviations[2];
} nsvcd__instant;

// An interval of time: instants at both ends, and at all keyframes between.
typedef struct nsvcd__tree_interval {
  // (2)
  const nsvcd__moving *bodies;
  double clearance;
  // (capacity)
  nsvcd__instant *instants;
  size_t count, capacity;
  double t0, t1;
  // half way; its time is -1 before it is needed
  nsvcd__instant middle;
} nsvcd__tree_interval;

// A node of each tree, and bounds of the distances of their points from their bodies' origins.
typedef struct nsvcd__node_pair {
  nsvcd__node nodes[2];
  double radii[2];
} nsvcd__node_pair;

static int nsvcd__are_leaves(const nsvcd__node_pair *pair) {
  return pair->nodes[0].count == 1 && pair->nodes[1].count == 1;
}

// A direction as it is written: two whole numbers.
typedef struct nsvcd__coded_normal {
  nsvcd__d3 along;
  uint32_t x, y;
  // of each number: 8, 16 or 24
  int bits;
} nsvcd__coded_normal;

static double nsvcd__lengths_at(const nsvcd__dtransform *a, const nsvcd__dtransform *b) {
  return fabs(a->position.x) + fabs(a->position.y) + fabs(a->position.z) +
         fabs(b->position.x) + fabs(b->position.y) + fabs(b->position.z);
}

static nsvcd__instant nsvcd__instant_at(const nsvcd__moving *bodies, double t) {
  nsvcd__instant at;
  memset(&at, 0, sizeof at);
  at.t = t;
  for (size_t n = 0; n < 2; n++) {
    at.poses[n] = nsvcd__transform_at(&bodies[n], t);
    at.lengths += bodies[n].model.extent;
  }
  at.lengths += nsvcd__lengths_at(&at.poses[0], &at.poses[1]);
  return at;
}

// Sets the interval. Returns 0 where there is no room for its keyframes.
static int nsvcd__tree_interval_to(nsvcd__tree_interval *s, double t0, double t1) {
  if (s->count > 0 && !(s->t0 < t0) && !(s->t0 > t0) && !(s->t1 < t1) && !(s->t1 > t1))
    return 1;
  double t = t0;
  s->t0 = t0;
  s->t1 = t1;
  s->middle.t = -1;
  for (s->count = 0; s->count < s->capacity;) {
    nsvcd__instant *at = &s->instants[s->count++];
    double next = t1;
    *at = nsvcd__instant_at(s->bodies, t);
    if (!(t < t1)) return 1;
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_motion_model *m = &s->bodies[n].model;
      next = nsvcd__min(m->next(m->motion, t), next);
    }
    for (size_t n = 0; n < 2; n++) {
      const nsvcd_motion_model *m = &s->bodies[n].model;
      at->deviations[n] = m->deviation(m->motion, t, next);
    }
    t = next;
  }
  return 0;
}

// ---- nodes

// The corner of a node's box, or of its few triangles, that is farthest along a direction in its
// frame.
static nsvcd__d3 nsvcd__farthest(const nsvcd_tree *tree, const nsvcd__node *node,
                                 nsvcd__d3 direction) {
  if (node->count > NSVCD__EXACT) {
    const nsvcd__box *box = &tree->boxes[node->box];
    return nsvcd__d3_of((double)(direction.x > 0 ? box->high.x : box->low.x),
                        (double)(direction.y > 0 ? box->high.y : box->low.y),
                        (double)(direction.z > 0 ? box->high.z : box->low.z));
  }
  const float *corners = tree->corners + 9 * (size_t)node->first;
  double most = -HUGE_VAL;
  size_t farthest = 0;
  for (size_t i = 0; i < 3 * (size_t)node->count; i++) {
    const double along = nsvcd__d3_dot(nsvcd__d3_row(corners, i), direction);
    farthest = along > most ? i : farthest;
    most = along > most ? along : most;
  }
  return nsvcd__d3_row(corners, farthest);
}

static nsvcd__d3 nsvcd__turned_by(const nsvcd__moving *moving, const nsvcd__dtransform *at,
                                  nsvcd__d3 x) {
  return nsvcd__d3_scale(nsvcd__dmat3_apply(&at->rotation, x), moving->model.scale);
}

// A direction of the world in a body's frame; for a, reversed: from each node to the other.
static nsvcd__d3 nsvcd__inward(const nsvcd__instant *at, size_t n, nsvcd__d3 along) {
  const nsvcd__d3 in = nsvcd__dmat3_apply_transpose(&at->poses[n].rotation, along);
  return nsvcd__d3_scale(in, n ? 1 : -1);
}

static nsvcd__d3 nsvcd__offset_at(const nsvcd__instant *at) {
  return nsvcd__d3_sub(at->poses[0].position, at->poses[1].position);
}

// Of all points a and b of two nodes, the difference a - b that is least along a direction.
static nsvcd__d3 nsvcd__least_apart(const nsvcd__tree_interval *s,
                                    const nsvcd__node_pair *pair, const nsvcd__instant *at,
                                    nsvcd__d3 along) {
  nsvcd__d3 ends[2];
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__moving *body = &s->bodies[n];
    const nsvcd__d3 in = nsvcd__inward(at, n, along);
    const nsvcd__d3 x = nsvcd__farthest(body->tree, &pair->nodes[n], in);
    ends[n] = nsvcd__turned_by(body, &at->poses[n], x);
  }
  return nsvcd__d3_add(nsvcd__d3_sub(ends[0], ends[1]), nsvcd__offset_at(at));
}

// The extent of a node along a direction in its frame. Three maxima side by side: each waits for
// the one before.
static double nsvcd__extent_along(const nsvcd_tree *tree, const nsvcd__node *node,
                                  nsvcd__d3 direction) {
  if (node->count > NSVCD__EXACT)
    return nsvcd__d3_dot(nsvcd__farthest(tree, node, direction), direction);
  const float *corners = tree->corners + 9 * (size_t)node->first;
  double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < node->count; i++) {
    for (size_t k = 0; k < 3; k++) {
      const nsvcd__d3 corner = nsvcd__d3_row(corners, 3 * i + k);
      most[k] = nsvcd__max(nsvcd__d3_dot(corner, direction), most[k]);
    }
  }
  return nsvcd__max(most[0], nsvcd__max(most[1], most[2]));
}

// How far apart two nodes are along a direction, times its length.
static double nsvcd__distance_along(const nsvcd__tree_interval *s,
                                    const nsvcd__node_pair *pair, const nsvcd__instant *at,
                                    nsvcd__d3 along) {
  double extents = 0;
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__moving *body = &s->bodies[n];
    const nsvcd__d3 in = nsvcd__inward(at, n, along);
    extents += body->model.scale * nsvcd__extent_along(body->tree, &pair->nodes[n], in);
  }
  return nsvcd__d3_dot(along, nsvcd__offset_at(at)) - extents;
}

static double nsvcd__node_radius(const nsvcd__moving *moving, const nsvcd__node *node) {
  const nsvcd__box *box = &moving->tree->boxes[node->box];
  const nsvcd__f3 corner = nsvcd__f3_max(box->high, nsvcd__f3_scale(box->low, -1));
  return 1.000002 * moving->model.scale * nsvcd__d3_norm(nsvcd__d3_widen(corner));
}

// No point of a node is farther from the line through its body's origin along a unit axis.
static double nsvcd__node_axis_radius(const nsvcd__moving *moving, const nsvcd__node *node,
                                      nsvcd__d3 axis) {
  const float *corners = moving->tree->corners + 9 * (size_t)node->first;
  const size_t count = node->count > NSVCD__EXACT ? 0 : 3 * (size_t)node->count;
  double square = 0;
  for (size_t i = 0; i < count; i++) {
    const nsvcd__d3 off = nsvcd__d3_cross(nsvcd__d3_row(corners, i), axis);
    square = nsvcd__max(square, nsvcd__d3_dot(off, off));
  }
  if (count == 0) {
    const nsvcd__box *box = &moving->tree->boxes[node->box];
    const nsvcd__d3 low = nsvcd__d3_widen(box->low);
    const nsvcd__d3 high = nsvcd__d3_widen(box->high);
    const nsvcd__d3 half = nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5);
    const nsvcd__d3 a = nsvcd__d3_of(fabs(axis.x), fabs(axis.y), fabs(axis.z));
    const nsvcd__d3 off = nsvcd__d3_cross(nsvcd__d3_mix(low, high, 0.5), axis);
    const double x = fabs(off.x) + half.y * a.z + half.z * a.y;
    const double y = fabs(off.y) + half.z * a.x + half.x * a.z;
    const double z = fabs(off.z) + half.x * a.y + half.y * a.x;
    square = x * x + y * y + z * z;
  }
  return 1.000002 * moving->model.scale * sqrt(square);
}

// How far points of a node leave their chords after an instant along a direction, times its length.
static double nsvcd__node_deviation(const nsvcd__moving *body, const nsvcd__node_pair *pair,
                                    const nsvcd__instant *at, size_t n, nsvcd__d3 along) {
  const nsvcd_deviation *d = &at->deviations[n];
  const double any = nsvcd__d3_norm(along) * (d->base + d->per_metre * pair->radii[n]);
  if (!(d->turn > 0)) return any;
  const nsvcd__d3 own = nsvcd__d3_of(d->axis[0], d->axis[1], d->axis[2]);
  const nsvcd__d3 axis = nsvcd__dmat3_apply(&at->poses[n].rotation, own);
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(along, axis));
  return any + d->turn * across * nsvcd__node_axis_radius(body, &pair->nodes[n], own);
}

// How much farther apart two nodes are along a direction than they have to be, times its length:
// the least at all instants and between them. Ends as soon as it is no more than `enough`.
static double nsvcd__slack_along(const nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                                 nsvcd__d3 along, double enough) {
  const double length = nsvcd__d3_norm(along);
  double slack = HUGE_VAL;
  double last = HUGE_VAL;
  double last_lengths = 0;
  double deviation = 0;
  for (size_t i = 0; i < s->count && slack > enough; i++) {
    const nsvcd__instant *at = &s->instants[i];
    const double lengths = pair->radii[0] + pair->radii[1] + s->clearance + at->lengths;
    const double distance = nsvcd__distance_along(s, pair, at, along);
    const double margin = NSVCD__CERTIFIED_MARGIN * nsvcd__max(lengths, last_lengths);
    const double least = length * (s->clearance + margin) + deviation;
    slack = nsvcd__min(slack, nsvcd__min(distance, last) - least);
    last = distance;
    last_lengths = lengths;
    deviation = 0;
    for (size_t n = 0; n < 2; n++)
      deviation += nsvcd__node_deviation(&s->bodies[n], pair, at, n, along);
  }
  return slack;
}

// Does a plane of this normal separate two nodes, at all instants and between them?
static int nsvcd__separates(const nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                            nsvcd__d3 along) {
  return nsvcd__slack_along(s, pair, along, 0) > 0;
}

// ---- normals

static double nsvcd__signed(double magnitude, double sign) {
  return sign < 0 ? -magnitude : magnitude;
}

// A direction in two whole numbers: a point of the octahedron |x| + |y| + |z| = half, seen from
// above, its lower half folded outwards (Meyer and others 2010).
static nsvcd__coded_normal nsvcd__normal_of(nsvcd__d3 along, int bits) {
  const double half = (double)((1 << (bits - 1)) - 1);
  const double sum = fabs(along.x) + fabs(along.y) + fabs(along.z);
  const double x = along.x * (half / sum);
  const double y = along.y * (half / sum);
  const int below = along.z < 0;
  nsvcd__coded_normal out;
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

// A direction, and how far apart two nodes are along it half way; less than 0: not at all.
typedef struct nsvcd__best {
  nsvcd__d3 along;
  double distance;
} nsvcd__best;

// Gilbert's iteration (1966) towards the point of a - b that is nearest to the origin. It ends
// where the best direction is nearly as good as the nearest point allows.
static nsvcd__best nsvcd__gilbert(const nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                                  const nsvcd__instant *at, nsvcd__d3 along) {
  nsvcd__best best = {along, -HUGE_VAL};
  nsvcd__d3 v = nsvcd__least_apart(s, pair, at, along);
  const double first = nsvcd__d3_norm(v);
  for (int n = 0; n < NSVCD__GILBERT_STEPS; n++) {
    const double length = nsvcd__d3_norm(v);
    if (!(length > NSVCD__GILBERT_LEAST * first)) break;
    const nsvcd__d3 w = nsvcd__least_apart(s, pair, at, v);
    const double distance = nsvcd__d3_dot(v, w) / length;
    if (distance > best.distance) {
      best.along = v;
      best.distance = distance;
    }
    if (distance - s->clearance > NSVCD__GILBERT_ENOUGH * (length - s->clearance)) break;
    const nsvcd__d3 to = nsvcd__d3_sub(w, v);
    const double square = nsvcd__d3_dot(to, to);
    if (!(square > 0)) break;
    const double fraction = -nsvcd__d3_dot(v, to) / square;
    v = nsvcd__d3_fma(nsvcd__max(0, nsvcd__min(fraction, 1)), to, v);
  }
  return best;
}

// Looks for a plane that separates two nodes for the whole interval. *best: the direction to begin
// with; it becomes the best one half way.
static int nsvcd__find_normal(nsvcd__tree_interval *s, const nsvcd__node_pair *pair,
                              nsvcd__best *best, nsvcd__coded_normal *normal) {
  nsvcd__instant *at = &s->middle;
  if (at->t < 0) *at = nsvcd__instant_at(s->bodies, 0.5 * (s->t0 + s->t1));
  if (nsvcd__are_leaves(pair)) {
    nsvcd__d3 t[2][3];
    for (size_t i = 0; i < 6; i++) {
      const size_t n = i / 3;
      const nsvcd__moving *body = &s->bodies[n];
      const float *corners = body->tree->corners + 9 * (size_t)pair->nodes[n].first;
      const nsvcd__d3 x = nsvcd__d3_row(corners, i % 3);
      t[n][i % 3] = nsvcd__turned_by(body, &at->poses[n], x);
    }
    for (size_t k = 0; k < 3; k++) t[0][k] = nsvcd__d3_add(t[0][k], nsvcd__offset_at(at));
    const nsvcd__nearest nearest = nsvcd__nearest_of(t[0], t[1]);
    best->along = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    best->distance = sqrt(nearest.square);
  } else {
    *best = nsvcd__gilbert(s, pair, at, best->along);
  }
  if (!(best->distance > s->clearance)) return 0;
  for (int bits = 8; bits <= 24; bits += 8) {
    *normal = nsvcd__normal_of(best->along, bits);
    if (nsvcd__separates(s, pair, normal->along)) return 1;
  }
  return 0;
}

// -------------------------------------------------------------------------------- certificate/rays
// In: two bodies at one time. Out: what a ray from a corner of one crosses of the other; whether an
// edge passes through a triangle.

#define NSVCD__UNCLEAR 2

// One body as another one sees it: in the other's frame, in units of its scale.
typedef struct nsvcd__seen {
  const nsvcd__moving *of, *by;
  nsvcd__dtransform of_at, by_at;
  // no length is more; no point is off by as much as the margin
  double lengths, margin;
} nsvcd__seen;

static nsvcd__seen nsvcd__seen_at(const nsvcd__moving *of, const nsvcd__moving *by, double t) {
  const nsvcd__node root = {0, 0, 1};
  nsvcd__seen s = {of, by, nsvcd__transform_at(of, t), nsvcd__transform_at(by, t), 0, 0};
  const double scale = by->model.scale;
  const double radii = nsvcd__node_radius(of, &root) + nsvcd__node_radius(by, &root);
  const double apart = nsvcd__d3_norm(nsvcd__d3_sub(s.of_at.position, s.by_at.position));
  const double positions =
      of->model.extent + by->model.extent + nsvcd__lengths_at(&s.of_at, &s.by_at);
  s.lengths = 1.000001 * (radii + apart) / scale;
  s.margin = NSVCD__CERTIFIED_MARGIN * (s.lengths + positions / scale);
  return s;
}

static nsvcd__d3 nsvcd__seen_vertex(const nsvcd__seen *s, uint32_t vertex) {
  const nsvcd__d3 x = nsvcd__d3_row(s->of->tree->mesh.positions, vertex);
  const nsvcd__d3 offset = nsvcd__d3_sub(s->of_at.position, s->by_at.position);
  const nsvcd__d3 world = nsvcd__d3_add(nsvcd__turned_by(s->of, &s->of_at, x), offset);
  return nsvcd__d3_scale(nsvcd__dmat3_apply_transpose(&s->by_at.rotation, world),
                         1 / s->by->model.scale);
}

// The corners of a triangle.
static void nsvcd__seen_triangle(const nsvcd__seen *s, uint32_t triangle, nsvcd__d3 *out) {
  const uint32_t *corners = s->of->tree->mesh.indices + 3 * (size_t)triangle;
  for (size_t k = 0; k < 3; k++) out[k] = nsvcd__seen_vertex(s, corners[k]);
}

// A ray in the frame of the other body: does it leave (1) or enter (-1) through a triangle of that,
// or miss it (0)? UNCLEAR: by too little.
static int nsvcd__ray_passes(const nsvcd__seen *s, uint32_t triangle, nsvcd__d3 from,
                             nsvcd__d3 along) {
  const double length = nsvcd__d3_norm(along);
  const double rounding = 1e-4 * NSVCD__CERTIFIED_MARGIN * s->lengths * s->lengths;
  nsvcd__d3 p[3], crosses[3];
  int left = 0;
  int right = 0;
  for (uint32_t k = 0; k < 3; k++) {
    const float *corner = nsvcd__tree_corner(s->by->tree, triangle, k);
    p[k] = nsvcd__d3_sub(nsvcd__d3_load(corner), from);
  }
  const double ahead =
      nsvcd__max(nsvcd__d3_dot(p[0], along),
                 nsvcd__max(nsvcd__d3_dot(p[1], along), nsvcd__d3_dot(p[2], along)));
  if (ahead < -1.01 * s->margin * length) return 0;
  for (size_t k = 0; k < 3; k++) {
    crosses[k] = nsvcd__d3_cross(p[k], p[(k + 1) % 3]);
    const double edge = sqrt(nsvcd__d3_distance2(p[k], p[(k + 1) % 3]));
    const double off =
        length * (s->margin * edge + rounding) + 2 * s->margin * nsvcd__d3_norm(crosses[k]);
    left += nsvcd__d3_dot(along, crosses[k]) > off;
    right += nsvcd__d3_dot(along, crosses[k]) < -off;
  }
  if (left > 0 && right > 0) return 0;
  if (left < 3 && right < 3) return NSVCD__UNCLEAR;
  const nsvcd__d3 sum = nsvcd__d3_add(crosses[1], crosses[2]);
  const nsvcd__d3 normal = nsvcd__d3_add(crosses[0], sum);
  const double volume = nsvcd__d3_dot(p[2], crosses[0]);
  const double off = s->margin * nsvcd__d3_norm(normal) + rounding * s->lengths;
  if (!(fabs(volume) > off)) return NSVCD__UNCLEAR;
  if ((volume > 0) != (left > 0)) return 0;
  return left > 0 ? 1 : -1;
}

// Does a ray miss a box for certain? Then some axis, across the ray and across a side of the box,
// separates them.
static int nsvcd__ray_misses(const nsvcd__box *box, nsvcd__d3 from, nsvcd__d3 along,
                             double margin) {
  const nsvcd__d3 low = nsvcd__d3_sub(nsvcd__d3_widen(box->low), from);
  const nsvcd__d3 high = nsvcd__d3_sub(nsvcd__d3_widen(box->high), from);
  const nsvcd__d3 middle = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5);
  const nsvcd__d3 half = nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5);
  const nsvcd__d3 size = nsvcd__d3_of(fabs(along.x), fabs(along.y), fabs(along.z));
  const nsvcd__d3 off = nsvcd__d3_cross(along, middle);
  return fabs(off.x) > size.y * half.z + size.z * half.y + margin ||
         fabs(off.y) > size.z * half.x + size.x * half.z + margin ||
         fabs(off.z) > size.x * half.y + size.y * half.x + margin;
}

// Casts a ray. *winding: how often the closed components of the other body wind about where it
// begins. sums: (vertices), scratch: what it crosses, by component. Returns 0 where that is not
// clear.
static int nsvcd__cast(const nsvcd__seen *s, nsvcd__d3 from, nsvcd__d3 along, int32_t *sums,
                       int *winding) {
  const nsvcd_tree *tree = s->by->tree;
  const double margin = s->margin * nsvcd__d3_norm(along);
  nsvcd__node stack[NSVCD__TREE_STACK] = {{0, 0, (uint32_t)tree->mesh.triangle_count}};
  size_t height = 1;
  memset(sums, 0, tree->mesh.vertex_count * sizeof *sums);
  while (height > 0) {
    const nsvcd__node node = stack[--height];
    if (nsvcd__ray_misses(&tree->boxes[node.box], from, along, margin)) continue;
    if (node.count > 1) {
      nsvcd__children(&node, &stack[height], &stack[height + 1]);
      height += 2;
      continue;
    }
    const uint32_t triangle = tree->order[node.first];
    const int crossed = nsvcd__ray_passes(s, triangle, from, along);
    if (crossed == NSVCD__UNCLEAR) return 0;
    sums[tree->component[tree->mesh.indices[3 * (size_t)triangle]]] += crossed;
  }
  *winding = 0;
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) *winding += tree->open[v] ? 0 : sums[v];
  return 1;
}

// --------------------------------------------------------------------------- certificate/traversal
// In: two motion models and two trees. Out: a certificate, or none. The form of its bits:
//
//   all       version 1 (6 bits), kind (2), digests of both meshes (8 each), of motions, scales and
//             the clearance (16)
//   FREE      the traversal, a code a visit, as examples/verify/nsvcd_verify.h has it: 0 opens the
//             node whose box is longer; 11 separated by the last normal; 101 by another, which
//             follows; 100 halves the time. Where the roots are nowhere separated: a ray for each
//             component of a, then of b, at t = 0: 1 along the last normal, or 0, and a normal
//   others    the time (32), then HIT: two triangles (32 each), whose edge (1), which (2); NEAR:
//             two triangles, a point on each (16, 16); INSIDE: whose corner (1), which (32), a
//             normal
//   a normal  the last eight are remembered: k zeros and a 1 are the one k + 1 before the last;
//             seven zeros a new one: 0, two numbers of 8 bits; 10, two of 16; 11, two of 24

// visits on the stack
#define NSVCD__TRAVERSAL_STACK 128
#define NSVCD__NO_EDGE 3u
#define NSVCD__SHORTEST_INTERVAL 1e-12
// normals
#define NSVCD__REMEMBERED 8
// of both nodes' sides: where they move farther, the time is halved
#define NSVCD__LONG_TRAVEL 0.35

enum { NSVCD__PROVES_FREE, NSVCD__PROVES_HIT, NSVCD__PROVES_NEAR, NSVCD__PROVES_INSIDE };

typedef struct nsvcd__visit {
  nsvcd__node_pair pair;
  double t0, t1;
} nsvcd__visit;

typedef struct nsvcd__certifier {
  nsvcd__moving bodies[2];
  nsvcd__tree_interval interval;
  // the last first
  nsvcd__d3 normals[NSVCD__REMEMBERED];
  uint8_t *bytes;
  size_t capacity, bits;
  // of motions, scales and the clearance
  uint32_t digest;
  // 1: the roots are, at some time
  int separated;
  // (vertices)
  int32_t *sums;
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

// The normal that is k > 0 before the last, or, where k is REMEMBERED, a new one. It becomes the
// last.
static void nsvcd__write_normal(nsvcd__certifier *c, size_t k,
                                const nsvcd__coded_normal *normal) {
  const int known = k < NSVCD__REMEMBERED;
  const nsvcd__d3 along = known ? c->normals[k] : normal->along;
  nsvcd__write_bits(c, (uint32_t)known, (int)(known ? k : k - 1));
  if (!known) {
    const uint32_t bytes = (uint32_t)normal->bits / 8;
    nsvcd__write_bits(c, bytes > 1 ? bytes : 0, bytes > 1 ? 2 : 1);
    nsvcd__write_bits(c, normal->x, normal->bits);
    nsvcd__write_bits(c, normal->y, normal->bits);
    k--;
  }
  for (; k > 0; k--) c->normals[k] = c->normals[k - 1];
  c->normals[0] = along;
}

static void nsvcd__write_head(nsvcd__certifier *c, uint32_t kind) {
  const uint32_t digests[3] = {c->bodies[0].tree->digest, c->bodies[1].tree->digest,
                               c->digest};
  c->bits = 0;
  // a reader has none yet
  memset(c->normals, 0, sizeof c->normals);
  nsvcd__write_bits(c, 1, 6);
  nsvcd__write_bits(c, kind, 2);
  for (size_t k = 0; k < 3; k++) {
    const uint32_t half = digests[k] ^ digests[k] >> 16;
    nsvcd__write_bits(c, k < 2 ? (half ^ half >> 8) & 0xff : half & 0xffff, k < 2 ? 8 : 16);
  }
}

// ---- hits

// The edge of a triangle that passes through one of the other body, if there is one.
static uint32_t nsvcd__piercing_edge(const nsvcd__seen *s, uint32_t own, uint32_t other) {
  nsvcd__d3 corners[3];
  nsvcd__seen_triangle(s, own, corners);
  for (uint32_t k = 0; k < 3; k++) {
    const nsvcd__d3 to = corners[(k + 1) % 3];
    const nsvcd__d3 along = nsvcd__d3_sub(to, corners[k]);
    const int there = nsvcd__ray_passes(s, other, corners[k], along);
    if (there != 1 && there != -1) continue;
    const nsvcd__d3 back = nsvcd__d3_scale(along, -1);
    if (nsvcd__ray_passes(s, other, to, back) == -there) return k;
  }
  return NSVCD__NO_EDGE;
}

// A point of a triangle as it is written. The line from the first corner through it meets the side
// opposite: code[0] is the point's fraction of that line, code[1] where on the side they meet.
// Returns the point that is read.
static nsvcd__d3 nsvcd__point_code(const nsvcd__d3 *t, nsvcd__d3 x, uint32_t *code) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  const nsvcd__d3 off = nsvcd__d3_sub(x, t[0]);
  const nsvcd__d3 first = nsvcd__d3_sub(t[1], t[0]);
  const nsvcd__d3 second = nsvcd__d3_sub(t[2], t[1]);
  const double square = nsvcd__d3_dot(n, n);
  // off = v (first + w second)
  const double vw = nsvcd__d3_dot(n, nsvcd__d3_cross(first, off)) / square;
  const double v =
      vw + nsvcd__d3_dot(n, nsvcd__d3_cross(off, nsvcd__d3_sub(t[2], t[0]))) / square;
  const int has_area = square > 0 && v > 0;
  code[0] = (uint32_t)(65535 * nsvcd__clamp_fraction(has_area ? v : 0) + 0.5);
  code[1] = (uint32_t)(65535 * nsvcd__clamp_fraction(has_area ? vw / v : 0) + 0.5);
  const nsvcd__d3 along = nsvcd__d3_fma((double)code[1] / 65535, second, first);
  return nsvcd__d3_fma((double)code[0] / 65535, along, t[0]);
}

// Are two triangles nearer to each other than the clearance, at points as they are written?
static int nsvcd__near_at(const nsvcd__certifier *c, const nsvcd__seen *s, uint32_t ta,
                          uint32_t tb, uint32_t *codes) {
  nsvcd__d3 a[3], b[3];
  nsvcd__seen own = *s;
  own.of = s->by;
  own.of_at = s->by_at;
  nsvcd__seen_triangle(s, ta, a);
  nsvcd__seen_triangle(&own, tb, b);
  const nsvcd__nearest nearest = nsvcd__nearest_of(a, b);
  const nsvcd__d3 on_a = nsvcd__point_code(a, nearest.on_a, codes);
  const nsvcd__d3 on_b = nsvcd__point_code(b, nearest.on_b, codes + 2);
  const double distance = sqrt(nsvcd__d3_distance2(on_a, on_b)) + s->margin;
  return s->by->model.scale * distance < c->interval.clearance;
}

// Do two triangles meet at a time, or come within the clearance? Then it writes the certificate.
static int nsvcd__meet_at(nsvcd__certifier *c, double when, uint32_t ta, uint32_t tb) {
  // the nearest time that can be written
  const double most = 4294967295.0;
  const uint32_t code = (uint32_t)(nsvcd__max(0, nsvcd__min(when, 1)) * most + 0.5);
  const double t = (double)code / most;
  const nsvcd__seen a = nsvcd__seen_at(&c->bodies[0], &c->bodies[1], t);
  const nsvcd__seen b = nsvcd__seen_at(&c->bodies[1], &c->bodies[0], t);
  uint32_t points[4];
  uint32_t edge = nsvcd__piercing_edge(&a, ta, tb);
  const uint32_t whose = edge == NSVCD__NO_EDGE;
  if (whose) edge = nsvcd__piercing_edge(&b, tb, ta);
  const int pierced = edge != NSVCD__NO_EDGE;
  if (!pierced && !(c->interval.clearance > 0 && nsvcd__near_at(c, &a, ta, tb, points)))
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

// ---- the traversal

// The longest side of a node's box.
static double nsvcd__node_side(const nsvcd__moving *moving, const nsvcd__node *node) {
  const nsvcd__box *box = &moving->tree->boxes[node->box];
  const nsvcd__d3 low = nsvcd__d3_widen(box->low);
  const nsvcd__d3 high = nsvcd__d3_widen(box->high);
  const nsvcd__d3 sides = nsvcd__d3_sub(high, low);
  return nsvcd__stored(moving->model.scale *
                       nsvcd__max(nsvcd__max(sides.x, sides.y), sides.z));
}

// How far one node's middle moves relative to the other's, from instant to instant.
static double nsvcd__relative_travel(const nsvcd__tree_interval *s,
                                     const nsvcd__node_pair *pair) {
  double travel = 0;
  nsvcd__d3 last = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i < s->count; i++) {
    const nsvcd__instant *at = &s->instants[i];
    nsvcd__d3 middles[2];
    for (size_t n = 0; n < 2; n++) {
      const nsvcd__moving *body = &s->bodies[n];
      const nsvcd__box *box = &body->tree->boxes[pair->nodes[n].box];
      const nsvcd__d3 sum =
          nsvcd__d3_add(nsvcd__d3_widen(box->low), nsvcd__d3_widen(box->high));
      middles[n] = nsvcd__turned_by(body, &at->poses[n], nsvcd__d3_scale(sum, 0.5));
    }
    const nsvcd__d3 now =
        nsvcd__d3_add(nsvcd__d3_sub(middles[0], middles[1]), nsvcd__offset_at(at));
    if (i > 0) travel += sqrt(nsvcd__d3_distance2(now, last));
    last = now;
  }
  return travel;
}

// Is the interval what keeps two nodes from being separated, rather than their size? sides: (2) of
// the nodes. best: the best direction half way.
static int nsvcd__is_too_long(const nsvcd__certifier *c, const nsvcd__node_pair *pair,
                              const double *sides, const nsvcd__best *best) {
  const double travel = nsvcd__relative_travel(&c->interval, pair);
  const double apart = best->distance - c->interval.clearance;
  if (!(apart > 0)) return travel > NSVCD__LONG_TRAVEL * (sides[0] + sides[1]);
  // half way they are separated: smaller nodes are needed only where these hardly move
  if (travel > 2 * NSVCD__LONG_TRAVEL * nsvcd__min(sides[0], sides[1])) return 1;
  const double least = -apart * nsvcd__d3_norm(best->along);
  return nsvcd__slack_along(&c->interval, pair, best->along, least) > least;
}

// Replaces a visit by two, in reverse order: to the children of the node whose box is longer, or in
// both halves of the time. Returns 0 where that is too short to halve.
static int nsvcd__divide_visit(nsvcd__certifier *c, nsvcd__visit *v, const nsvcd__best *best) {
  nsvcd__node *nodes = v->pair.nodes;
  const double sides[2] = {nsvcd__node_side(&c->bodies[0], &nodes[0]),
                           nsvcd__node_side(&c->bodies[1], &nodes[1])};
  const int halves =
      nsvcd__are_leaves(&v->pair) || nsvcd__is_too_long(c, &v->pair, sides, best);
  v[1] = *v;
  nsvcd__write_bits(c, halves ? 4 : 0, halves ? 3 : 1);
  if (halves) {
    v[1].t1 = v->t0 = 0.5 * (v->t0 + v->t1);
    return v->t1 - v[1].t0 >= NSVCD__SHORTEST_INTERVAL;
  }
  const size_t n = nodes[1].count > 1 && (nodes[0].count == 1 || sides[0] < sides[1]);
  nsvcd__children(&nodes[n], &v[1].pair.nodes[n], &nodes[n]);
  return 1;
}

// Depth first, over pairs of nodes and intervals of time. HIT: the certificate is that of a hit;
// FREE: that of all of t0 to t1.
static nsvcd_verdict nsvcd__prove_traversal(nsvcd__certifier *c, double t0, double t1,
                                            size_t visits) {
  nsvcd__visit stack[NSVCD__TRAVERSAL_STACK];
  size_t height = 1;
  int is_unresolved = 0;
  memset(stack, 0, sizeof *stack);
  for (size_t n = 0; n < 2; n++)
    stack->pair.nodes[n].count = (uint32_t)c->bodies[n].tree->mesh.triangle_count;
  stack->t0 = t0;
  stack->t1 = t1;
  c->separated = 0;
  nsvcd__write_head(c, NSVCD__PROVES_FREE);
  while (height > 0) {
    nsvcd__visit *v = &stack[height - 1];
    nsvcd__node_pair *pair = &v->pair;
    nsvcd__best best = {c->normals[0], 0};
    nsvcd__coded_normal normal;
    for (size_t n = 0; n < 2; n++)
      pair->radii[n] = nsvcd__node_radius(&c->bodies[n], &pair->nodes[n]);
    if (c->made->visits >= visits) {
      c->made->why = NSVCD_WHY_WORK;
      return NSVCD_UNDECIDED;
    }
    c->made->visits++;
    if (!nsvcd__tree_interval_to(&c->interval, v->t0, v->t1)) return NSVCD_UNDECIDED;
    size_t k = 0;
    while (k < NSVCD__REMEMBERED && !nsvcd__separates(&c->interval, pair, c->normals[k])) k++;
    if (k < NSVCD__REMEMBERED || nsvcd__find_normal(&c->interval, pair, &best, &normal)) {
      nsvcd__write_bits(c, k > 0 ? 5 : 3, k > 0 ? 3 : 2);
      if (k > 0) nsvcd__write_normal(c, k, &normal);
      if (pair->nodes[0].box == 0 && pair->nodes[1].box == 0) c->separated = 1;
      height--;
      continue;
    }
    if (nsvcd__are_leaves(pair)) {
      const uint32_t ta = c->bodies[0].tree->order[pair->nodes[0].first];
      const uint32_t tb = c->bodies[1].tree->order[pair->nodes[1].first];
      if (nsvcd__meet_at(c, 0.5 * (v->t0 + v->t1), ta, tb)) return NSVCD_HIT;
    }
    if (height == NSVCD__TRAVERSAL_STACK) return NSVCD_UNDECIDED;
    if (nsvcd__divide_visit(c, v, &best)) {
      height++;
      continue;
    }
    // they touch, or nearly: others may still be proven to meet
    is_unresolved = 1;
    height--;
  }
  if (is_unresolved) c->made->why = NSVCD_WHY_TOO_NEAR;
  return is_unresolved ? NSVCD_UNDECIDED : NSVCD_FREE;
}

// ----------------------------------------------------------------------------- certificate/certify
// In: two motion models, two trees, perhaps an answer. Out: a certificate of what is free, of two
// triangles that meet, or of a corner that is inside; or none.

// rays that are tried for a component
#define NSVCD__RAYS 64
// instants at which a hit is looked for, and visits at each, at most
#define NSVCD__INSTANTS 12
#define NSVCD__INSTANT_VISITS 2000
// visits to all of the motion before that
#define NSVCD__FIRST_VISITS 100000

// ---- containment

// A direction to try: along the axes, then anywhere.
static nsvcd__coded_normal nsvcd__ray_to_try(size_t k, uint64_t *random) {
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

// Casts rays from all components of one body, at t = 0, which show them outside. FREE: all are
// written. HIT: one shows a corner inside, and the certificate is written. UNDECIDED: of some
// component none is clear.
static nsvcd_verdict nsvcd__cast_all(nsvcd__certifier *c, int whose) {
  const nsvcd_tree *tree = c->bodies[whose].tree;
  const nsvcd__seen s = nsvcd__seen_at(&c->bodies[whose], &c->bodies[!whose], 0);
  uint64_t random = 1;
  for (uint32_t v = 0; v < tree->mesh.vertex_count; v++) {
    if (tree->component[v] != v) continue;
    const nsvcd__d3 from = nsvcd__seen_vertex(&s, v);
    int shown = 0;
    for (size_t k = 0; k <= NSVCD__RAYS && !shown; k++) {
      const int same = k == 0;
      const nsvcd__coded_normal ray = nsvcd__ray_to_try(same ? 0 : k - 1, &random);
      const nsvcd__d3 along = same ? c->normals[0] : ray.along;
      int winding;
      if (!nsvcd__cast(&s, from, along, c->sums, &winding)) continue;
      shown = winding == 0;
      if (shown) {
        nsvcd__write_bits(c, (uint32_t)same, 1);
        if (!same) nsvcd__write_normal(c, NSVCD__REMEMBERED, &ray);
      } else if (!same) {
        nsvcd__write_head(c, NSVCD__PROVES_INSIDE);
        nsvcd__write_bits(c, 0, 32);
        nsvcd__write_bits(c, (uint32_t)whose, 1);
        nsvcd__write_bits(c, v, 32);
        nsvcd__write_normal(c, NSVCD__REMEMBERED, &ray);
        c->made->inside = 1;
        c->made->verdict = NSVCD_HIT;
        return NSVCD_HIT;
      }
    }
    if (!shown) return NSVCD_UNDECIDED;
  }
  return NSVCD_FREE;
}

// ---- answers

// Looks for a hit where an answer has one, and a little later and earlier: at the time itself the
// triangles may only touch.
static int nsvcd__meet_as_answered(nsvcd__certifier *c, const nsvcd_answer *answer) {
  const nsvcd_contact *hint = answer->contact_count > 0 ? answer->contacts : &answer->nearest;
  const int named = hint->triangle_a < c->bodies[0].tree->mesh.triangle_count &&
                    hint->triangle_b < c->bodies[1].tree->mesh.triangle_count;
  if (answer->verdict != NSVCD_HIT) return 0;
  for (int whose = 0; whose < 2 && answer->inside; whose++)
    if (nsvcd__cast_all(c, whose) == NSVCD_HIT) return 1;
  if (!named || !(hint->time >= 0)) return 0;
  if (nsvcd__meet_at(c, (double)hint->time, hint->triangle_a, hint->triangle_b)) return 1;
  for (double later = 1e-7; later < 1; later *= 2) {
    for (int k = 0; k < 2; k++) {
      const double when = (double)hint->time + (k ? -later : later);
      if (nsvcd__meet_at(c, when, hint->triangle_a, hint->triangle_b)) return 1;
    }
  }
  return 0;
}

// 1, 1/2, 1/4, 3/4, 1/8, 5/8, ...
static double nsvcd__bit_reversed(int k) {
  double fraction = k == 0;
  double bit = 0.5;
  for (int n = k; n > 0; n /= 2, bit /= 2) fraction += n % 2 * bit;
  return fraction;
}

// Looks for a hit at single instants, from an answer's on or anywhere.
static int nsvcd__meet_at_instants(nsvcd__certifier *c, const nsvcd_answer *answer,
                                   size_t visits) {
  if (answer && answer->verdict == NSVCD_FREE) return 0;
  const double said = answer ? (double)answer->time.high : -1;
  const int is_known = answer && answer->verdict == NSVCD_HIT && said >= 0 && said <= 1;
  const double from = is_known ? said : 0;
  for (int k = NSVCD__INSTANTS; k >= 0; k--) {
    // soon after an answer's; or at the end, a half, quarters, eighths
    const double fraction = is_known ? ldexp(1, -k) : nsvcd__bit_reversed(NSVCD__INSTANTS - k);
    const double t = nsvcd__min(from + (1 - from) * fraction, 1 - NSVCD__SHORTEST_INTERVAL);
    const size_t most = c->made->visits + NSVCD__INSTANT_VISITS;
    const size_t limit = most < visits ? most : visits;
    if (nsvcd__prove_traversal(c, t, t + NSVCD__SHORTEST_INTERVAL, limit) == NSVCD_HIT)
      return 1;
  }
  return 0;
}

// Over all time a traversal may lose itself among triangles that only touch, as those of flat
// bodies that are set down: then, and where an answer says so, a hit is looked for at instants.
static nsvcd_verdict nsvcd__prove_answer(nsvcd__certifier *c, const nsvcd_answer *answer,
                                         size_t visits) {
  const int is_hit = answer && answer->verdict == NSVCD_HIT;
  const size_t first = visits < NSVCD__FIRST_VISITS ? visits : NSVCD__FIRST_VISITS;
  if (!is_hit) {
    const nsvcd_verdict verdict = nsvcd__prove_traversal(c, 0, 1, first);
    const int is_open = verdict == NSVCD_UNDECIDED && c->made->why != NSVCD_WHY_NOTHING;
    if (!is_open || c->made->visits >= visits) return verdict;
  }
  const int touches = c->made->why == NSVCD_WHY_TOO_NEAR;
  const int meets = nsvcd__meet_at_instants(c, answer, visits);
  c->made->why = touches && !meets ? NSVCD_WHY_TOO_NEAR : NSVCD_WHY_NOTHING;
  if (meets) return NSVCD_HIT;
  return touches ? NSVCD_UNDECIDED : nsvcd__prove_traversal(c, 0, 1, visits);
}

static int nsvcd__has_open(const nsvcd_tree *tree) {
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) {
    if (tree->open[v]) return 1;
  }
  return 0;
}

// ---- nsvcd_certify

// Lays the workspace out at base, or, where that is NULL, only counts.
static uint64_t nsvcd__certifier_layout(size_t instants, const nsvcd_tree *a,
                                        const nsvcd_tree *b, char *base, nsvcd__certifier *c) {
  uint64_t used = 0;
  const size_t vertices = a->mesh.vertex_count > b->mesh.vertex_count ? a->mesh.vertex_count
                                                                      : b->mesh.vertex_count;
  c->interval.capacity = instants;
  c->interval.instants = NSVCD__TAKE_ROWS(nsvcd__instant, instants, base, &used);
  c->sums = NSVCD__TAKE_ROWS(int32_t, vertices, base, &used);
  return used;
}

NSVCDDEF size_t nsvcd_certify_models_workspace_size(size_t keyframes, const nsvcd_tree *a,
                                                    const nsvcd_tree *b) {
  nsvcd__certifier counted;
  if (!a || !b || keyframes > SIZE_MAX / 1024) return 0;
  const uint64_t size = nsvcd__certifier_layout(keyframes + 2, a, b, NULL, &counted);
  return size > SIZE_MAX ? 0 : (size_t)size;
}

NSVCDDEF nsvcd_result nsvcd_certify_models(
    const nsvcd_motion_model *models, size_t keyframes, float clearance, const nsvcd_tree *a,
    const nsvcd_tree *b, const nsvcd_certify_options *options, void *workspace,
    size_t workspace_size, uint8_t *bytes, size_t capacity, nsvcd_certificate *made) {
  const nsvcd_certify_options defaults = {NULL, 0};
  const nsvcd_certify_options *o = options ? options : &defaults;
  nsvcd__certifier c;
  nsvcd_certificate out;
  if (!models || !a || !b || !made || (capacity > 0 && !bytes)) return NSVCD_ERROR_ARGUMENT;
  memset(&c, 0, sizeof c);
  memset(&out, 0, sizeof out);
  if (!nsvcd__is_finite(clearance) || clearance < 0 || clearance > NSVCD_MAX_COORDINATE)
    return NSVCD_ERROR_CLEARANCE;
  const size_t needed = nsvcd_certify_models_workspace_size(keyframes, a, b);
  if (!workspace || !nsvcd__is_aligned(workspace) || !needed || workspace_size < needed)
    return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__certifier_layout(keyframes + 2, a, b, (char *)workspace, &c);
  c.bodies[0].tree = a;
  c.bodies[1].tree = b;
  for (size_t n = 0; n < 2; n++) c.bodies[n].model = models[n];
  c.interval.bodies = c.bodies;
  c.interval.clearance = (double)clearance;
  c.bytes = bytes;
  c.capacity = capacity;
  c.digest = nsvcd__digest(models[0].digest + 31 * models[1].digest, &clearance, 1);
  c.made = &out;
  const nsvcd_answer *told = o->answer;
  const size_t visits = o->visits ? o->visits : NSVCD_DEFAULT_VISITS;
  if (!told || !nsvcd__meet_as_answered(&c, told)) {
    out.verdict = nsvcd__prove_answer(&c, told, visits);
    if (out.verdict == NSVCD_FREE && !c.separated) out.verdict = nsvcd__cast_all(&c, 0);
    if (out.verdict == NSVCD_FREE && !c.separated) out.verdict = nsvcd__cast_all(&c, 1);
  }
  // of the meshes, of which none is mended: in a certificate an open component contains nothing
  const int is_inside = told && (told->inside || told->why == NSVCD_WHY_OPEN);
  const int has_open = nsvcd__has_open(a) || nsvcd__has_open(b);
  if (is_inside && has_open && out.verdict == NSVCD_FREE) {
    out.verdict = NSVCD_UNDECIDED;
    out.why = NSVCD_WHY_OPEN;
  }
  out.size = out.verdict == NSVCD_UNDECIDED ? 0 : (c.bits + 7) / 8;
  if (out.verdict == NSVCD_UNDECIDED && !out.why) out.why = NSVCD_WHY_TOO_NEAR;
  *made = out;
  return NSVCD_OK;
}

static size_t nsvcd__keyframes_of(const nsvcd_question *question) {
  return nsvcd__pose_count(&question->a) + nsvcd__pose_count(&question->b);
}

NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b) {
  if (!question || nsvcd__track_check(&question->a) || nsvcd__track_check(&question->b))
    return 0;
  return nsvcd_certify_models_workspace_size(nsvcd__keyframes_of(question), a, b);
}

NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made) {
  nsvcd_mover movers[2];
  nsvcd_motion_model models[2];
  if (!question || !a || !b || !made || (capacity > 0 && !bytes)) return NSVCD_ERROR_ARGUMENT;
  nsvcd_result result = nsvcd__model_of(&question->a, &movers[0], &models[0]);
  if (!result) result = nsvcd__model_of(&question->b, &movers[1], &models[1]);
  if (result) return result;
  if (!(question->slop <= 0 && question->slop >= 0)) return NSVCD_ERROR_SLOP;
  return nsvcd_certify_models(models, nsvcd__keyframes_of(question), question->clearance, a, b,
                              options, workspace, workspace_size, bytes, capacity, made);
}

#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // NEURALSVCD_CERTIFY_IMPLEMENTATION

// Licence: LICENSE, or the end of neuralsvcd.h.
