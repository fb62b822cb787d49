// In: derivatives by a pair. Out: those by the poses of both movers.
#pragma once
#include "../entry/processor.h"
#include "by_pair.h"

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
