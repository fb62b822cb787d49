// In: a mesh that moves. Out: where it is at a time, and how far points leave the chords between
// their positions at two times. In double, and shares nothing with the floor of motions: a
// certificate is a second opinion.
#pragma once
#include "../ground/rotations.h"
#include "tree.h"

// A pose as a matrix: takes a corner x to turn (scale x) + at.
typedef struct nsvcd__pose_matrix {
  nsvcd__dmat3 turn;
  nsvcd__d3 at;
} nsvcd__pose_matrix;

// A mesh that moves.
typedef struct nsvcd__moving {
  const nsvcd_tree *tree;
  nsvcd_motion_model model;
} nsvcd__moving;

static nsvcd__pose_matrix nsvcd__pose_matrix_at(const nsvcd__moving *moving, double t) {
  const nsvcd_pose64 at = moving->model.pose_at(moving->model.motion, t);
  const double *q = at.rotation;
  const double *p = at.position;
  const nsvcd__dquat turn = {q[0], q[1], q[2], q[3]};
  const nsvcd__pose_matrix out = {nsvcd__dmat3_of(nsvcd__dquat_unit(turn)),
                                  nsvcd__d3_of(p[0], p[1], p[2])};
  return out;
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

// The slerp from a pose to the next: unit rotations, on the shorter side; half of its angle.
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
  // rounded to double at each sum: its sign says in which direction a turn by 180 degrees goes
  double dot = 0;
  for (size_t k = 0; k < 4; k++)
    dot = nsvcd__stored(dot + (double)a->rotation[k] * (double)b->rotation[k]);
  const double side = dot < 0 ? -1 : 1;
  out.from = nsvcd__dquat_unit(nsvcd__pose_rotation(a));
  out.to = nsvcd__dquat_scale(nsvcd__dquat_unit(nsvcd__pose_rotation(b)), side);
  const nsvcd__dquat d = nsvcd__dquat_fma(-1, out.from, out.to);
  const nsvcd__dquat s = nsvcd__dquat_fma(1, out.from, out.to);
  out.half_angle = 2 * atan2(sqrt(nsvcd__dquat_dot(d, d)), sqrt(nsvcd__dquat_dot(s, s)));
  return out;
}

static nsvcd_pose64 nsvcd__mover_pose(const void *motion, double t) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  const nsvcd_pose *a = mover->poses;
  nsvcd__dquat q = nsvcd__pose_rotation(a);
  nsvcd__d3 at = nsvcd__d3_load(a->position);
  if (mover->count > 1) {
    const size_t k = nsvcd__pose_index(mover, t);
    const double from = nsvcd__mover_keyframe(mover, k);
    const double u = (t - from) / (nsvcd__mover_keyframe(mover, k + 1) - from);
    a += k;
    const nsvcd__turning arc = nsvcd__turning_of(a, a + 1);
    double before = 1 - u;
    double after = u;
    // below, a line is as good
    if (arc.half_angle > 1e-7) {
      before = sin((1 - u) * arc.half_angle);
      after = sin(u * arc.half_angle);
    }
    q = nsvcd__dquat_fma(after, arc.to, nsvcd__dquat_scale(arc.from, before));
    at = nsvcd__d3_mix(nsvcd__d3_load(a->position), nsvcd__d3_load(a[1].position), u);
  }
  const nsvcd_pose64 out = {{at.x, at.y, at.z}, {q.x, q.y, q.z, q.w}};
  return out;
}

static double nsvcd__mover_next(const void *motion, double t) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  return mover->count > 1 ? nsvcd__mover_keyframe(mover, nsvcd__pose_index(mover, t) + 1) : 1;
}

// A turn by h at a constant rate about an axis a moves a point y with a second derivative of h^2 a
// x (a x y). The point leaves its chord by an eighth of that: along n, by h^2 / 8 (n x a).(a x y).
static nsvcd_deviation nsvcd__mover_deviation(const void *motion, double t0, double t1) {
  const nsvcd_mover *mover = (const nsvcd_mover *)motion;
  nsvcd_deviation out;
  memset(&out, 0, sizeof out);
  if (mover->count == 1) return out;
  const size_t k = nsvcd__pose_index(mover, 0.5 * (t0 + t1));
  const nsvcd_pose *a = mover->poses + k;
  const double whole = nsvcd__mover_keyframe(mover, k + 1) - nsvcd__mover_keyframe(mover, k);
  const nsvcd__turning arc = nsvcd__turning_of(a, a + 1);
  const double h = 2 * arc.half_angle * (t1 - t0) / whole;
  const nsvcd__d3 turn = nsvcd__dquat_axis(nsvcd__dquat_inverse_mul(arc.from, arc.to));
  const nsvcd__d3 axis = nsvcd__d3_unit(turn, nsvcd__d3_of(0, 0, 0));
  memcpy(out.axis, &axis, sizeof out.axis);
  *(nsvcd__d3_norm(axis) > 0 ? &out.turn : &out.per_metre) = 0.1250001 * h * h;
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
