// In: a mesh that moves. Out: where it is at a time, and how far points leave the chords between
// their positions at two times. With the proof it shares the law of motion, ground/motions, and
// nothing else: a certificate is a second opinion, and its checker has a law of its own.
#pragma once
#include "../ground/motions.h"
#include "tree.h"

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
