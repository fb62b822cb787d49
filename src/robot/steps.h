// In: a motion of the joints, and two times. Out: what the joints do between them.
#pragma once
#include "mimics.h"

// A step of a motion: from one time to another, h later.
typedef struct nsvcd__step {
  // the joints at both
  double from[NSVCD_MAX_JOINTS], to[NSVCD_MAX_JOINTS];
  // |d|, d = to - from; max |q - from|
  double travel[NSVCD_MAX_JOINTS], farthest[NSVCD_MAX_JOINTS];
  // at least 8 |e|, see robot/deviation.h
  double bend[NSVCD_MAX_JOINTS];
} nsvcd__step;

// Squared: radians and metres alike.
static double nsvcd__distance2(const double *a, const double *b, size_t joints) {
  double sum = 0;
  for (size_t j = 0; j < joints; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

// A motion of no pieces is its first point, whatever else it says.
static nsvcd_joint_motion nsvcd__motion_meant(const nsvcd_joint_motion *motion) {
  const nsvcd_joint_motion still = {0, 0, motion->points, NULL};
  return motion->pieces ? *motion : still;
}

static double nsvcd__piece_start(const nsvcd_joint_motion *m, size_t piece) {
  return m->times ? m->times[piece] : (double)piece;
}

static double nsvcd__piece_time(const nsvcd_joint_motion *m, size_t piece) {
  return nsvcd__piece_start(m, piece + 1) - nsvcd__piece_start(m, piece);
}

// The piece that a time is in; where two pieces meet, the later one.
static size_t nsvcd__piece_at(const nsvcd_joint_motion *m, double time) {
  size_t low = 0;
  size_t high = m->pieces;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(nsvcd__piece_start(m, middle) <= time ? &low : &high) = middle;
  }
  return low;
}

// How much of a piece has gone by at a time: in [0,1].
static double nsvcd__fraction_at(const nsvcd_joint_motion *m, size_t piece, double time) {
  const double start = nsvcd__piece_start(m, piece);
  if (time >= nsvcd__piece_start(m, piece + 1)) return 1;
  return time > start ? (time - start) / nsvcd__piece_time(m, piece) : 0;
}

// The control points of one joint in a piece.
static void nsvcd__joint_points(const nsvcd_joint_motion *m, size_t piece, size_t joints,
                                size_t joint, double *p) {
  const double *first = m->points + piece * m->degree * joints + joint;
  for (size_t i = 0; i <= m->degree; i++) p[i] = first[i * joints];
}

// Cuts a curve to its fractions from s0 to s1: de Casteljau's algorithm, twice.
static void nsvcd__cut_curve(double *p, size_t degree, double s0, double s1) {
  const double before = s1 > 0 ? s0 / s1 : 0;
  // the first s1 of it: p[i] becomes the point of level i
  for (size_t level = 1; level <= degree && s1 < 1; level++) {
    for (size_t i = degree; i >= level; i--) p[i] = p[i - 1] + s1 * (p[i] - p[i - 1]);
  }
  // of that, what is after s0
  for (size_t level = 1; level <= degree && before > 0; level++) {
    for (size_t i = 0; i + level <= degree; i++) p[i] = p[i] + before * (p[i + 1] - p[i]);
  }
}

// The joints at a fraction of a piece, and, unless NULL, their speeds.
static void nsvcd__joints_at(const nsvcd_joint_motion *m, size_t joints, size_t piece,
                             double fraction, double *at, double *speeds) {
  const size_t degree = m->degree;
  for (size_t j = 0; j < joints; j++) {
    double p[NSVCD_MAX_DEGREE + 1];
    nsvcd__joint_points(m, piece, joints, j, p);
    for (size_t level = degree; level > 0; level--) {
      if (level == 1 && speeds)
        speeds[j] = (double)degree * (p[1] - p[0]) / nsvcd__piece_time(m, piece);
      // both ends exactly
      for (size_t i = 0; i < level; i++)
        p[i] = fraction < 1 ? p[i] + fraction * (p[i + 1] - p[i]) : p[i + 1];
    }
    at[j] = p[0];
  }
}

// The same at a time.
static void nsvcd__joints_at_time(const nsvcd_joint_motion *m, size_t joints, double time,
                                  double *at, double *speeds) {
  const size_t piece = nsvcd__piece_at(m, time);
  const double fraction = nsvcd__fraction_at(m, piece, time);
  nsvcd__joints_at(m, joints, piece, fraction, at, speeds);
}

NSVCDDEF void nsvcd_motion_at(const nsvcd_joint_motion *motion, size_t joints, double time,
                              double *out) {
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  nsvcd__joints_at_time(&m, joints, time, out, NULL);
}

// By how much the speed of a joint jumps where a piece begins.
static double nsvcd__jump_at(const nsvcd_joint_motion *m, size_t joints, size_t piece,
                             size_t joint) {
  const double *at = m->points + piece * m->degree * joints + joint;
  const double before = (at[0] - *(at - joints)) / nsvcd__piece_time(m, piece - 1);
  const double after = (at[joints] - at[0]) / nsvcd__piece_time(m, piece);
  return fabs((double)m->degree * (after - before));
}

// What the joints do from time t0 to t1, which may span several pieces. Where the speed jumps by v,
// e has a corner, and |e| grows by h v / 4 at most.
static void nsvcd__step_of(const nsvcd_joint_motion *m, size_t joints, double t0, double t1,
                           nsvcd__step *step) {
  const size_t degree = m->degree;
  const double twice = (double)(degree * (degree - 1));
  const size_t first = nsvcd__piece_at(m, t0);
  size_t last = first;
  double v0[NSVCD_MAX_JOINTS], v1[NSVCD_MAX_JOINTS];
  double along = 0;
  double square = 0;
  const double h = t1 - t0;
  while (last + 1 < m->pieces && nsvcd__piece_start(m, last + 1) < t1) last++;
  const double begin = nsvcd__fraction_at(m, first, t0);
  const double end = nsvcd__fraction_at(m, last, t1);
  nsvcd__joints_at(m, joints, first, begin, step->from, v0);
  nsvcd__joints_at(m, joints, last, end, step->to, v1);
  for (size_t j = 0; j < joints; j++) {
    const double d = step->to[j] - step->from[j];
    step->travel[j] = step->farthest[j] = fabs(d);
    step->bend[j] = 0;
    if (degree > 1) along += d * h * (v1[j] - v0[j]);
    square += d * d;
  }
  if (degree == 1 && first == last) return;
  // what suits the mean of the second derivatives
  const double g = square > 0 ? nsvcd__max(-2, nsvcd__min(2, along / square)) : 0;
  for (size_t j = 0; j < joints; j++) {
    const double from = step->from[j];
    const double d = step->to[j] - from;
    double jumps = 0;
    for (size_t piece = first; piece <= last; piece++) {
      double p[NSVCD_MAX_DEGREE + 1], second[NSVCD_MAX_DEGREE + 1];
      const double s0 = piece == first ? begin : 0;
      const double s1 = piece == last ? end : 1;
      const double per_piece = h / nsvcd__piece_time(m, piece);
      nsvcd__joint_points(m, piece, joints, j, p);
      for (size_t i = 0; i + 2 <= degree; i++)
        second[i] = per_piece * per_piece * twice * (p[i] - 2 * p[i + 1] + p[i + 2]);
      if (degree >= 2) nsvcd__cut_curve(second, degree - 2, s0, s1);
      nsvcd__cut_curve(p, degree, s0, s1);
      for (size_t i = 0; i <= degree; i++)
        step->farthest[j] = nsvcd__max(step->farthest[j], fabs(p[i] - from));
      for (size_t i = 0; i + 2 <= degree; i++)
        step->bend[j] = nsvcd__max(step->bend[j], fabs(second[i] - g * d));
      if (piece > first) jumps += nsvcd__jump_at(m, joints, piece, j);
    }
    step->bend[j] += 2 * h * jumps;
  }
}
