// In: motions of some of the joints, each on a clock of its own. Out: one motion of all joints.
#pragma once
#include "../interface/merges.h"
#include "check.h"

// of the time of the whole: times that are no farther apart are one
#define NSVCD__ONE_TIME 1e-12

// What motions have in common.
typedef struct nsvcd__merge {
  size_t joints;
  // that a merged motion can have, at most; its degree
  size_t pieces, degree;
  // seconds: times that are no farther apart are one
  double same;
  // joints that some motion moves
  uint8_t moved[NSVCD_MAX_JOINTS];
} nsvcd__merge;

// When a piece begins, or the last one ends, on the clock of all.
static double nsvcd__knot_at(const nsvcd_partial_motion *m, size_t piece) {
  return m->delay + nsvcd__piece_start(&m->motion, piece);
}

// Are the motions in order? Fills in *all.
static nsvcd_result nsvcd__merge_check(const nsvcd_partial_motion *motions, size_t count,
                                       size_t joints, nsvcd__merge *all) {
  double first = 0;
  double last = 0;
  memset(all, 0, sizeof *all);
  all->joints = joints;
  all->degree = 1;
  if (joints < 1 || joints > NSVCD_MAX_JOINTS) return NSVCD_ERROR_COUNT;
  if (count > 0 && !motions) return NSVCD_ERROR_ARGUMENT;
  const size_t most = SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints / 2;
  for (size_t n = 0; n < count; n++) {
    const nsvcd_partial_motion *m = &motions[n];
    const nsvcd_joint_motion meant = nsvcd__motion_meant(&m->motion);
    if (!m->joints || !meant.points) return NSVCD_ERROR_ARGUMENT;
    if (m->joint_count < 1 || m->joint_count > joints) return NSVCD_ERROR_COUNT;
    for (size_t k = 0; k < m->joint_count; k++) {
      if (m->joints[k] >= joints || all->moved[m->joints[k]]++) return NSVCD_ERROR_JOINT;
    }
    const nsvcd_result result = nsvcd__pieces_check(&meant, m->joint_count);
    if (result) return result;
    if (!nsvcd__are_numbers(&m->delay, 1)) return NSVCD_ERROR_TIMES;
    if (meant.pieces == 0) continue;
    if (meant.pieces >= most - all->pieces) return NSVCD_ERROR_DEGREE;
    const double begin = nsvcd__knot_at(m, 0);
    const double end = nsvcd__knot_at(m, meant.pieces);
    first = all->pieces ? nsvcd__min(first, begin) : begin;
    last = all->pieces ? nsvcd__max(last, end) : end;
    all->pieces += meant.pieces + 1;
    if (meant.degree > all->degree) all->degree = meant.degree;
  }
  all->same = NSVCD__ONE_TIME * (last - first);
  for (size_t n = 0; n < count; n++) {
    const nsvcd_partial_motion *m = &motions[n];
    for (size_t p = 0; p < m->motion.pieces; p++)
      if (!(nsvcd__knot_at(m, p + 1) - nsvcd__knot_at(m, p) > all->same))
        return NSVCD_ERROR_TIMES;
  }
  return NSVCD_OK;
}

// Writes the times at which pieces of any motion begin or end, rising. Returns how many they are.
static size_t nsvcd__merge_times(const nsvcd_partial_motion *motions, size_t count,
                                 double same, double *times) {
  size_t next[NSVCD_MAX_JOINTS] = {0};
  for (size_t written = 0;; written++) {
    int is_over = 1;
    for (size_t n = 0; n < count; n++) {
      if (motions[n].motion.pieces == 0 || next[n] > motions[n].motion.pieces) continue;
      const double time = nsvcd__knot_at(&motions[n], next[n]);
      if (is_over || time < times[written]) times[written] = time;
      is_over = 0;
    }
    if (is_over) return written;
    for (size_t n = 0; n < count; n++) {
      if (motions[n].motion.pieces == 0 || next[n] > motions[n].motion.pieces) continue;
      next[n] += nsvcd__knot_at(&motions[n], next[n]) <= times[written] + same;
    }
  }
}

// Raises the degree of a curve. Points that are the same stay so, and so do the ends.
static void nsvcd__raise_degree(double *p, size_t degree, size_t to) {
  for (; degree < to; degree++) {
    const double whole = (double)(degree + 1);
    p[degree + 1] = p[degree];
    for (size_t i = degree; i > 0; i--) p[i] += (double)i / whole * (p[i - 1] - p[i]);
  }
}

// Writes one joint of a motion, its column k, into the merged one, whose times are known. A piece
// goes from one of these to another, and is cut at those in between.
static void nsvcd__merge_joint(const nsvcd_partial_motion *m, size_t k,
                               const nsvcd__merge *all, const nsvcd_joint_motion *merged,
                               double *points) {
  const size_t own = m->motion.pieces;
  const size_t degree = all->degree;
  double *column = points + m->joints[k];
  size_t row = 0;
  size_t at = 0;
  while (own > 0 && nsvcd__knot_at(m, 0) > merged->times[at] + all->same) at++;
  for (; row <= at * degree; row++) column[row * all->joints] = m->motion.points[k];
  for (size_t piece = 0; piece < own; piece++) {
    size_t end = at + 1;
    while (nsvcd__knot_at(m, piece + 1) > merged->times[end] + all->same) end++;
    const double start = merged->times[at];
    const double whole = merged->times[end] - start;
    for (; at < end; at++) {
      double p[NSVCD_MAX_DEGREE + 1];
      const double to = at + 1 < end ? (merged->times[at + 1] - start) / whole : 1;
      nsvcd__joint_points(&m->motion, piece, m->joint_count, k, p);
      nsvcd__cut_curve(p, m->motion.degree, (merged->times[at] - start) / whole, to);
      nsvcd__raise_degree(p, m->motion.degree, degree);
      for (size_t i = 0; i <= degree; i++) column[(at * degree + i) * all->joints] = p[i];
    }
    row = at * degree + 1;
  }
  for (; row <= merged->pieces * degree; row++)
    column[row * all->joints] = column[(row - 1) * all->joints];
}

// Lays a merged motion out at base, which is aligned, or, where that is NULL, only counts. Returns
// the bytes; 0 if they are more than can be counted.
static size_t nsvcd__merge_layout(const nsvcd__merge *all, char *base, double **points,
                                  double **times) {
  uint64_t used = 0;
  const size_t rows = all->pieces * all->degree + 1;
  *points = NSVCD__TAKE_ROWS(double, (rows * all->joints), base, &used);
  *times = NSVCD__TAKE_ROWS(double, all->pieces + 1, base, &used);
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_merge_motions_size(const nsvcd_partial_motion *motions, size_t count,
                                         size_t joints) {
  nsvcd__merge all;
  double *unused[2];
  if (nsvcd__merge_check(motions, count, joints, &all)) return 0;
  return nsvcd__merge_layout(&all, NULL, &unused[0], &unused[1]);
}

NSVCDDEF nsvcd_result nsvcd_merge_motions(const nsvcd_partial_motion *motions, size_t count,
                                          size_t joints, const double *rest, void *memory,
                                          size_t size, nsvcd_joint_motion *merged) {
  nsvcd__merge all;
  double *points, *times;
  const nsvcd_result result = nsvcd__merge_check(motions, count, joints, &all);
  if (result) return result;
  if (!merged) return NSVCD_ERROR_ARGUMENT;
  for (size_t j = 0; j < joints; j++) {
    if (all.moved[j]) continue;
    if (!rest) return NSVCD_ERROR_ARGUMENT;
    if (!nsvcd__are_numbers(&rest[j], 1)) return NSVCD_ERROR_VALUE;
  }
  const size_t needed = nsvcd__merge_layout(&all, NULL, &points, &times);
  if (!memory || !nsvcd__is_aligned(memory) || !needed || size < needed)
    return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__merge_layout(&all, (char *)memory, &points, &times);
  const size_t knots = nsvcd__merge_times(motions, count, all.same, times);
  const nsvcd_joint_motion out = {knots ? knots - 1 : 0, all.degree, points, times};
  for (size_t row = 0; row <= out.pieces * out.degree; row++) {
    for (size_t j = 0; j < joints; j++)
      if (!all.moved[j]) points[row * joints + j] = rest[j];
  }
  for (size_t n = 0; n < count; n++) {
    for (size_t k = 0; k < motions[n].joint_count; k++)
      nsvcd__merge_joint(&motions[n], k, &all, &out, points);
  }
  *merged = out;
  return NSVCD_OK;
}
