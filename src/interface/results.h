// In: nothing. Out: codes of what may fail, what they say, and the caller's allocator.
#pragma once
#include "options.h"

typedef enum nsvcd_result {
  NSVCD_OK = 0,
  // NULL where it is not allowed
  NSVCD_ERROR_ARGUMENT,
  // the file is missing or cannot be read
  NSVCD_ERROR_IO,
  // the allocator returned NULL
  NSVCD_ERROR_MEMORY,
  // the memory given is NULL, not aligned to NSVCD_ALIGNMENT bytes, or too small: size, capacity
  NSVCD_ERROR_WORKSPACE,
  // by the caller's progress function
  NSVCD_ERROR_CANCELLED,
  // a count is 0, or larger than the library takes: of joints, parts, goals or what a guess has
  NSVCD_ERROR_COUNT,

  // ---- files and meshes
  // the file is of another format, or, of what is binary, cut short
  NSVCD_ERROR_FORMAT,
  // a line that cannot be understood, or a face of one or two vertices
  NSVCD_ERROR_SYNTAX,
  // an index that is zero, or refers to no vertex
  NSVCD_ERROR_INDEX,
  // a coordinate is not finite, or larger than NSVCD_MAX_COORDINATE
  NSVCD_ERROR_NUMBER,
  // no triangle, no area, or all of it within NSVCD_MIN_RADIUS
  NSVCD_ERROR_EMPTY,
  // more vertices, triangles or bytes than can be counted
  NSVCD_ERROR_TOO_LARGE,
  // sizes of faces: fewer than three, or in all not corner_count
  NSVCD_ERROR_SIZES,
  // low or high is not finite, or low is not less than high
  NSVCD_ERROR_BOX,
  // more patches than NSVCD_MAX_PATCHES, or a patch_radius that is negative or not finite
  NSVCD_ERROR_PATCHES,
  // a radius, `round` or `half` is not positive where it must be, not finite, or beyond
  // NSVCD_MAX_COORDINATE
  NSVCD_ERROR_RADIUS,

  // ---- bodies
  // what is passed as a body is none, is damaged, cut short or misaligned
  NSVCD_ERROR_BODY,
  // a body of another version, model or byte order
  NSVCD_ERROR_VERSION,
  // a body without triangles, which a proof needs
  NSVCD_ERROR_TRIANGLES,
  // a body without latents, which the network needs; or they were asked for where there are none:
  // without the network, or of what is round
  NSVCD_ERROR_LATENTS,

  // ---- questions
  // poses that are NULL have a count of 0, others one of 1 to NSVCD_MAX_POSES
  NSVCD_ERROR_POSES,
  // times that do not rise, or, of poses, not from 0 to 1
  NSVCD_ERROR_TIMES,
  // a pose's position is not finite, or beyond NSVCD_MAX_COORDINATE
  NSVCD_ERROR_POSE,
  // a quaternion's length is not 1, to NSVCD_UNIT_TOLERANCE
  NSVCD_ERROR_QUATERNION,
  // a scale is not finite, negative or out of range, or makes a body too small or too large
  NSVCD_ERROR_SCALE,
  // both sides of a question are the same body in the same motion: something was passed twice
  NSVCD_ERROR_SAME,
  // `ask` is none of its values
  NSVCD_ERROR_ASK,
  // `method` is none of its values, or cannot answer this: the network knows no FIRST, to,
  // clearance or slop, and no proof has a gradient
  NSVCD_ERROR_METHOD,
  // `to` is negative, not finite, too large, or set where HIT is asked
  NSVCD_ERROR_TO,
  // `to_time` is not in [0,1], or set where FIRST is not asked
  NSVCD_ERROR_TO_TIME,
  // `clearance` is negative, not finite or too large
  NSVCD_ERROR_CLEARANCE,
  // `slop` is negative, not finite or too large, or set for a certificate
  NSVCD_ERROR_SLOP,
  // `tolerance` is negative, not finite or too large
  NSVCD_ERROR_TOLERANCE,
  // `manifold` is set where FIRST is not asked
  NSVCD_ERROR_MANIFOLD,
  // `segments` is not a multiple of 16 up to 64
  NSVCD_ERROR_SEGMENTS,
  // `network.pairs` is more than NSVCD_MAX_PAIRS
  NSVCD_ERROR_PAIRS,
  // `network.model` is none of its values, or not compiled in
  NSVCD_ERROR_MODEL,
  // `network.precision` is none of its values, or not compiled in
  NSVCD_ERROR_PRECISION,
  // `network.recall` is none of those there are
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
  // a link is no joint of the scene, or a part none of its parts
  NSVCD_ERROR_LINK,
  // a pair that is not there, or that names a part that is not there, or two that never move apart
  NSVCD_ERROR_PAIR,
  // a joint's value is not finite or too large: in a start, a goal, a motion's points
  NSVCD_ERROR_VALUE,
  // `degree` is not 1 to NSVCD_MAX_DEGREE, or pieces are more than can be counted
  NSVCD_ERROR_DEGREE,
  // a motion whose joints turn too far in a piece to be certified
  NSVCD_ERROR_TURN,
  // `finest` is negative or not finite
  NSVCD_ERROR_FINEST,
  // `within` or `deepest` is negative, not finite or too large
  NSVCD_ERROR_DISTANCE,
  // `farthest` is negative, not finite or too large
  NSVCD_ERROR_FARTHEST,
  // `nodes` or `shortcuts` is too large, or `edge` negative
  NSVCD_ERROR_ROUTE,
  // a planner's stage is out of range
  NSVCD_ERROR_STAGE,
  // a planner's weight, duration or margin is not finite, or its seeds or checks are too many
  NSVCD_ERROR_PLAN,

  // ---- this build
  // the compiler, or its flags, made a program that computes wrongly
  NSVCD_ERROR_BUILD
} nsvcd_result;

// What a result says, for a person: a sentence without a full stop, never NULL. It names the field
// at fault, as it is called here.
NSVCDDEF const char *nsvcd_result_string(nsvcd_result result);

// Does this build compute rightly, on this processor? Certificates of one that does not are false.
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
