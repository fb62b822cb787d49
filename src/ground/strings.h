// In: a code, a verdict or a status. Out: what it says, in English.
#pragma once
#include "../interface/plans.h"
#include "compiler.h"

// Text n of several in a row, in the order of enumerators; the last if n is too large. No table of
// pointers: a loader would have to write into that.
static const char *nsvcd__text_of(const char *texts, size_t n) {
  for (; n > 0 && texts[strlen(texts) + 1]; n--) texts += strlen(texts) + 1;
  return texts;
}

// Two, as C99 promises no more than 4095 characters of one.
static const char nsvcd__result_texts[] =
    "ok\0"
    "a pointer is NULL that must not be: an argument, or a body or an array in one\0"
    "the file is missing or cannot be read\0"
    "out of memory\0"
    "the memory given is NULL, misaligned, or smaller than the function for its size says\0"
    "cancelled\0"
    "a count is 0, or larger than the library takes: joint_count, joints, part_count, "
    "body_count, goal_count, guess_count or capacity; or the world is full\0"
    "the file is of another format than is read here, or is cut short\0"
    "a line cannot be understood, or a face has fewer than three corners\0"
    "an index is zero or refers to no vertex, or no body\0"
    "a coordinate is not finite, or beyond a million metres\0"
    "there is no triangle, or no area, or the mesh is smaller than 1e-12 metres\0"
    "more vertices, triangles or bytes than can be counted\0"
    "sizes: a face has fewer than three corners, or all together not corner_count\0"
    "low or high is not finite, or low is not less than high on each axis\0"
    "patches is more than 65536, or patch_radius is negative or not finite\0"
    "radius, convex_radius or half is negative, wrongly zero, not finite or too large\0"
    "this is not a body: its first bytes are others, or it is damaged, cut short or "
    "misaligned\0"
    "the body is of another version, model or byte order: encode the mesh again\0"
    "a body holds no triangles, which a proof needs: encode it without no_triangles\0"
    "a body holds no latents, which the network needs: encode it with them, without "
    "convex_radius\0"
    "poses and count do not agree: count is 0 where poses is NULL, else 1 to 65536\0"
    "times do not rise, of poses not from 0 to 1 by 1e-7 or more, of merged motions not by "
    "1e-12 of all; or seconds, of a frame, is not above 0\0"
    "a pose's position is not finite or too large\0"
    "a quaternion (x y z w) is not of unit length, to 1e-4\0"
    "a scale is not finite, negative or out of range, or makes a body too small or too "
    "large\0"
    "a pivot is not finite or too large, or is set for a certificate\0"
    "both sides are the same body in the same motion\0"
    "ask is none of its values\0"
    "method is none of its values, or cannot answer this: the network knows no FIRST, to, "
    "clearance or slop; proofs have no gradient\0"
    "to is negative, not finite or too large, or set where HIT is asked\0"
    "to_time is not in 0 to 1, or set where FIRST is not asked\0"
    "clearance is negative, not finite or too large\0"
    "slop is negative, not finite or too large, or set for a certificate\0"
    "a tolerance is negative, not finite or too large\0"
    "manifold is set where FIRST is not asked\0"
    "segments is not a multiple of 16 up to 64\0"
    "network.pairs is more than 256\0"
    "network.model is none of its values, or not compiled in\0"
    "network.precision is none of its values, or not compiled in\0"
    "network.recall is none of 0, 0.99, 0.999 and 0.9999\0"
    "network.inflate is negative or not finite\0";

// From NSVCD_ERROR_JOINT on.
static const char nsvcd__joint_texts[] =
    "a joint's kind is none of its values, its parent does not come before it, two motions "
    "move it, or it is none of the scene's\0"
    "the axis of a joint or a cone, its direction, or free_axis has no length, or is not "
    "finite, or up is not of unit length\0"
    "a joint's limits are not finite or too large, low is above high, or they exclude those "
    "of one that mimics it\0"
    "a speed or acceleration is negative (a joint's), not finite or too large\0"
    "a link is no joint of the scene, or a part none of its parts\0"
    "a pair is not there, or its parts are not, are one, or are on one link\0"
    "a cone's angle is not more than 0 and less than pi\0"
    "a joint's value (start, goal, guess, points) is not finite or too large; or a mover's "
    "mass, inertia, friction, restitution, slope or damping is out of range\0"
    "degree is not 1 to 5, or pieces are more than can be counted\0"
    "joints turn too far in a piece of the motion to be certified\0"
    "finest is negative or not finite\0"
    "max_distance, max_depth, apart or step is negative, not finite or too large\0"
    "farthest is negative, not finite or too large\0"
    "nodes or shortcuts is too large, or edge is negative or no number\0"
    "a held joint has another value in a goal or the guess than in the start\0"
    "mimic: a joint follows none, or one that follows another, its multiplier or offset is "
    "out of range, or its value is another than they make it\0"
    "explore or refine: via_points, segments, iterations, draws or noise is out of range\0"
    "velocity, acceleration, jerk, collision, duration or margin is not finite, "
    "or seeds or check too large\0"
    "the world is changed at the same time\0"
    "this build computes wrongly: see the compiler, and its flags\0"
    "unknown result\0";

NSVCDDEF const char *nsvcd_result_string(nsvcd_result result) {
  const size_t n = (size_t)result;
  if (n < NSVCD_ERROR_JOINT) return nsvcd__text_of(nsvcd__result_texts, n);
  return nsvcd__text_of(nsvcd__joint_texts, n - NSVCD_ERROR_JOINT);
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
