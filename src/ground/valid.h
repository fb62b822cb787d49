// In: what a caller passes. Out: is it valid?
#pragma once
#include "../interface/queries.h"
#include "bits.h"

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
