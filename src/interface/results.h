// In: nothing. Out: result codes, their texts, and the caller's allocator.
#pragma once
#include "options.h"

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
  // a count is 0, or larger than the library takes: of joints, parts, goals, points of a guess,
  // solutions, or balls
  NSVCD_ERROR_COUNT,

  // ---- files and meshes
  // the file has another format, or is a binary one that is cut short
  NSVCD_ERROR_FORMAT,
  // a line cannot be understood, or a face has one or two vertices
  NSVCD_ERROR_SYNTAX,
  // an index is zero, or refers to no vertex, or no body of the world
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
  // a tolerance is negative, not finite or too large
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
  // a joint's kind is none of its values, or its parent does not come before it; of motions that
  // are merged, an index is not one of the joints', or two of them move one joint
  NSVCD_ERROR_JOINT,
  // the axis of a joint or a cone, or a cone's direction, has no length, or is not finite; or
  // `free_axis` is not finite; or `up` is neither 0 nor of unit length
  NSVCD_ERROR_AXIS,
  // a joint's limits are not finite or too large, or low is above high
  NSVCD_ERROR_LIMITS,
  // a speed or acceleration is negative (a joint's), not finite or too large
  NSVCD_ERROR_SPEED,
  // a link or a part is not one of the scene's
  NSVCD_ERROR_LINK,
  // a pair is not one of the scene's; or it names a part that is not, one part twice, or two parts
  // on one link
  NSVCD_ERROR_PAIR,
  // a cone's angle is not more than 0 and less than pi
  NSVCD_ERROR_CONE,
  // a joint's value in a start, a goal or a motion is not finite or too large; or a mass, a
  // friction and the like of a mover is negative, not finite or too large
  NSVCD_ERROR_VALUE,
  // `degree` is not 1 to NSVCD_MAX_DEGREE, or there are more pieces than can be counted
  NSVCD_ERROR_DEGREE,
  // the motion has no pieces, or too many, or its joints move too far or too fast to be certified
  NSVCD_ERROR_TURN,
  // `finest` is negative or not finite
  NSVCD_ERROR_FINEST,
  // `max_distance`, `max_depth`, `apart` or `step` is negative, not finite or too large
  NSVCD_ERROR_DISTANCE,
  // `farthest` is negative, not finite or too large
  NSVCD_ERROR_FARTHEST,
  // `nodes` or `shortcuts` is too large, or `edge` negative
  NSVCD_ERROR_ROUTE,
  // a joint that is held has another value in a goal, or in the guess, than in the start
  NSVCD_ERROR_HELD,
  // a joint mimics none of the scene's, or one that mimics; its multiplier is no number from 1e-6
  // up or minus that, or, where both turn without limits, no whole number; or its value in a
  // configuration or a motion is not what its leader makes it
  NSVCD_ERROR_MIMIC,
  // a planner's stage is out of range
  NSVCD_ERROR_STAGE,
  // a planner's weight, duration or margin is not finite, or it has too many seeds or checks
  NSVCD_ERROR_PLAN,

  // ---- worlds
  // the world was changed while it was asked or changed, by another thread or a callback
  NSVCD_ERROR_WORLD,

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
