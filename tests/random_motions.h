// random_motions.h - motions, random ones, and where they take a point, in double. After the
// implementation.
#ifndef NSVCD_TESTS_RANDOM_MOTIONS_H
#define NSVCD_TESTS_RANDOM_MOTIONS_H

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

typedef struct pose64 {
  double q[4], p[3];
} pose64;

static pose64 to_double(const nsvcd_pose *pose) {
  pose64 out;
  double square = 0;
  for (int k = 0; k < 4; k++) {
    out.q[k] = (double)pose->rotation[k];
    square += out.q[k] * out.q[k];
  }
  for (int k = 0; k < 4; k++) out.q[k] /= sqrt(square);
  for (int k = 0; k < 3; k++) out.p[k] = (double)pose->position[k];
  return out;
}

// v + 2 w (u x v) + 2 u x (u x v)
static void rotate64(const double *q, const double *v, double *out) {
  double c[3] = {q[1] * v[2] - q[2] * v[1], q[2] * v[0] - q[0] * v[2], q[0] * v[1] - q[1] * v[0]};
  double d[3] = {q[1] * c[2] - q[2] * c[1], q[2] * c[0] - q[0] * c[2], q[0] * c[1] - q[1] * c[0]};
  for (int k = 0; k < 3; k++) out[k] = v[k] + 2 * (q[3] * c[k] + d[k]);
}

// A motion as examples/FORMATS.md has it, in double.
static pose64 pose_at(const nsvcd_pose *samples, size_t count, double t) {
  if (count == 1) return to_double(&samples[0]);
  double at = t * (double)(count - 1);
  size_t k = (size_t)at;
  if (k > count - 2) k = count - 2;
  double u = at - (double)k;
  double dot = 0;
  pose64 a = to_double(&samples[k]);
  pose64 b = to_double(&samples[k + 1]);
  pose64 out;
  for (int i = 0; i < 4; i++) dot += a.q[i] * b.q[i];
  for (int i = 0; i < 4 && dot < 0; i++) b.q[i] = -b.q[i];
  double angle = acos(fmin(fabs(dot), 1));
  double wa = 1 - u;
  double wb = u;
  double square = 0;
  if (angle > 1e-7) {
    wa = sin((1 - u) * angle) / sin(angle);
    wb = sin(u * angle) / sin(angle);
  }
  for (int i = 0; i < 4; i++) {
    out.q[i] = wa * a.q[i] + wb * b.q[i];
    square += out.q[i] * out.q[i];
  }
  for (int i = 0; i < 4; i++) out.q[i] /= sqrt(square);
  for (int i = 0; i < 3; i++) out.p[i] = (1 - u) * a.p[i] + u * b.p[i];
  return out;
}

// A body-frame point of the moving body at time t, in the fixed body's frame.
static void place64(const pose64 *at, const pose64 *fixed, const double *point, double *out) {
  double world[3];
  double back[4] = {-fixed->q[0], -fixed->q[1], -fixed->q[2], fixed->q[3]};
  rotate64(at->q, point, world);
  for (int k = 0; k < 3; k++) world[k] += at->p[k] - fixed->p[k];
  rotate64(back, world, out);
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
