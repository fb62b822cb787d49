// In: nothing. Out: codes of what may fail, what they say, and the caller's allocator.
#pragma once
#include "options.h"

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
