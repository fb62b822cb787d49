// random_motions.h - motions, random ones, and where they take a point, in double. After the
// implementation.
#ifndef NSVCD_TESTS_RANDOM_MOTIONS_H
#define NSVCD_TESTS_RANDOM_MOTIONS_H

#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "question_of.h"
#include "random_numbers.h"

// A header and nothing behind it: what a motion looks at of a body.
static const struct nsvcd_body any_body = {
    NSVCD__BODY_MAGIC, NSVCD__BODY_VERSION, 0, 64 + 16 * 32, 0, 1, 16, {0, 0, 0}, 0, 0, 0, 0, 0};

// As nsvcd_sweep does; bodies do not matter to it.
static nsvcd_result motion_init(const nsvcd_pose *samples, size_t count,
                                const nsvcd_pose *fixed_pose, nsvcd__motion *motion) {
  const nsvcd_question question =
      question_of(&any_body, samples, count, &any_body, fixed_pose, NULL);
  nsvcd_result result = nsvcd__mover_check(&question.a);
  if (!result) result = nsvcd__mover_check(&question.b);
  if (!result) nsvcd__motion_init(&question.a, &question.b, motion);
  return result;
}

static nsvcd_pose poses[NSVCD_MAX_POSES];

// A motion as examples/FORMATS.md has it, by the oracle.
static oracle_pose pose_at(const nsvcd_pose *samples, size_t count, double t) {
  if (count == 1) return pose_widened(samples);
  const double at = t * (double)(count - 1);
  const size_t k = (size_t)fmin(at, (double)(count - 2));
  const oracle_pose ends[2] = {pose_widened(&samples[k]), pose_widened(&samples[k + 1])};
  return oracle_pose_between(&ends[0], &ends[1], at - (double)k);
}

// Where a body is as seen by another one that is at `fixed`.
static oracle_pose seen_from(const nsvcd_pose *fixed, const oracle_pose *at) {
  const oracle_pose from = pose_widened(fixed);
  const double *q = from.rotation, *p = from.position;
  const double away[3] = {-p[0], -p[1], -p[2]};
  oracle_pose back = {{0, 0, 0}, {-q[0], -q[1], -q[2], q[3]}};
  oracle_transform(&back, away, back.position);
  return oracle_compose(&back, at);
}

// Kinds: 0 smooth, turning by `turn` in all about one axis; 1 smooth with a wobble; 2 jumping at
// random.
static void random_motion(size_t count, int kind, double turn, double path, const double *middle) {
  double axis[3], along[3], start[4];
  float q[4];
  random_quat(q);
  double length = sqrt((double)(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])) + 1e-9;
  for (int k = 0; k < 3; k++) {
    axis[k] = (double)q[k] / length;
    along[k] = uniform(-1, 1) * path;
  }
  random_quat(q);
  for (int k = 0; k < 4; k++) start[k] = (double)q[k];
  for (size_t n = 0; n < count; n++) {
    double t = count > 1 ? (double)n / (double)(count - 1) : 0.5;
    double half = 0.5 * turn * t;
    double s = sin(half);
    double c = cos(half);
    double wobble = kind == 1 ? 0.3 * sin(7 * t) : 0;
    const double *b = start;
    const double a[4] = {s * axis[0], s * axis[1], s * axis[2], c};
    poses[n].rotation[0] = (float)(a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1]);
    poses[n].rotation[1] = (float)(a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0]);
    poses[n].rotation[2] = (float)(a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3]);
    poses[n].rotation[3] = (float)(a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]);
    for (int k = 0; k < 3; k++) {
      poses[n].position[k] =
          (float)(middle[k] + along[k] * (t - 0.5) + (k == 0 ? wobble * path : 0));
    }
    if (kind == 2) {
      random_quat(poses[n].rotation);
      for (int k = 0; k < 3; k++) poses[n].position[k] = (float)(middle[k] + uniform(-1, 1) * path);
    }
    double sign = uniform(-1, 1) < 0 ? -1 : 1;
    double scale = sign * uniform(1 - 9e-5, 1 + 9e-5);  // still unit to 1e-4
    for (int k = 0; k < 4; k++)
      poses[n].rotation[k] = (float)((double)poses[n].rotation[k] * scale);
  }
}

#endif
