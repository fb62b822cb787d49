// In: candidates, and the motion. Out: pairs of patches in the fixed body's frame: where they are
// halfway through the interval in which their balls meet, and how they move, linearised about that
// time. A slice of candidates at a time, one per lane.
#pragma once
#include "../search/intervals.h"

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
