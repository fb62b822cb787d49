// In: two triangles that touch at the start of a motion. Out: how deep, and which directions undo
// it.
#pragma once
#include "triangle_pairs.h"

#ifndef NSVCD_NO_PROOF
// How deep a touch is along n: how far the moving triangle must go to be beyond the other; negative
// if it is beyond it already.
static double nsvcd__depth_along(nsvcd__d3 n, const nsvcd__touch *t) {
  return -nsvcd__beyond(n, t->moving, t->fixed);
}

// Is a touch too deep for the slop in every direction? Those to try are the separating axes: a
// normal of either triangle, or across an edge of each.
static int nsvcd__is_deep(const nsvcd__proof *p, const nsvcd__touch *t) {
  const nsvcd__d3 push_out = nsvcd__d3_widen(p->arcs.motion->push_out);
  const double most = p->push.slop - p->given.clearance;
  for (size_t k = 0; k < 12; k++) {
    nsvcd__d3 n = k < 3 ? t->directions[k] : nsvcd__across_edges(t->moving, t->fixed, k - 3);
    if (!(nsvcd__d3_dot(n, n) > 0.5)) continue;
    for (int side = 0; side < 2; side++) {
      const double pushed_out = nsvcd__d3_dot(push_out, n);
      if (pushed_out + nsvcd__depth_along(n, t) <= most) return 0;
      n = nsvcd__d3_scale(n, -1);
    }
  }
  return 1;
}

// Does a push-out along n, by what is left of the slop in that direction, undo a touch? If it has
// to push, it must not go through both faces. Going through one is harmless: a cone's side, which
// rises from the rim that the cone stands on, looks up, and so does the floor under it.
static int nsvcd__undoes(const nsvcd__proof *p, nsvcd__d3 n, const nsvcd__touch *t) {
  const double more = nsvcd__depth_along(n, t);
  const double pushed_out = nsvcd__d3_dot(nsvcd__d3_widen(p->arcs.motion->push_out), n);
  if (!(nsvcd__d3_dot(n, n) > 0.5)) return 0;
  if (pushed_out + more + p->given.clearance > p->push.slop) return 0;
  if (more < 0) return 1;
  return nsvcd__d3_dot(n, t->directions[0]) > -0.3 ||
         nsvcd__d3_dot(n, t->directions[1]) > -0.3;
}

// The squared distance of two triangles after the moving one has gone so far along n.
static double nsvcd__gap_after(const nsvcd__touch *t, nsvcd__d3 n, double distance) {
  nsvcd__d3 moved[3];
  for (int k = 0; k < 3; k++)
    moved[k] = nsvcd__d3_add(t->moving[k], nsvcd__d3_scale(n, distance));
  return nsvcd__nearest_of(moved, t->fixed).square;
}

// How far along n the moving triangle of a touch must go until it is beyond the clearance for good,
// which it is after `most`; -HUGE_VAL if it never is within it. The distance is convex: thirds find
// where it is least, and halves where it is the clearance. epsilon: of depths, in double.
static NSVCD__NOINLINE double nsvcd__exit_depth(const nsvcd__touch *t, nsvcd__d3 n,
                                                double clearance, double most,
                                                double epsilon) {
  // Parallel faces meet at one time only.
  const double limit = clearance + nsvcd__min(0.003 * most, epsilon);
  const double square = limit * limit;
  // nearly always
  if (nsvcd__gap_after(t, n, 0.998 * most) <= square) return most;
  double low = 0;
  double high = most;
  double inner = 0;  // where it is within the clearance
  int met = nsvcd__gap_after(t, n, 0) <= square;
  for (int k = 0; k < 16 && !met; k++) {
    const double third = (high - low) / 3;
    const double before = nsvcd__gap_after(t, n, low + third);
    const double after = nsvcd__gap_after(t, n, high - third);
    met = before <= square || after <= square;
    inner = after <= square ? high - third : low + third;
    if (before < after) high -= third;
    if (!(before < after)) low += third;
  }
  if (!met) return -HUGE_VAL;
  for (double beyond = most; beyond - inner > nsvcd__max(1e-3 * beyond, 1e-5 * most);) {
    const double middle = 0.5 * (inner + beyond);
    const int is_inner = nsvcd__gap_after(t, n, middle) <= square;
    *(is_inner ? &inner : &beyond) = middle;
  }
  return inner;
}

// Notes how deep a touch is along normal k.
static void nsvcd__note_depth(nsvcd__proof *p, size_t k, const nsvcd__touch *t) {
  const nsvcd__d3 n = p->push.normals[k];
  const double pushed_out = nsvcd__d3_dot(nsvcd__d3_widen(p->arcs.motion->push_out), n);
  const double most = nsvcd__depth_along(n, t) + p->given.clearance;
  p->push.needed = nsvcd__max(p->push.needed, pushed_out + most);
  if (!(most > 0) || !(pushed_out + most > p->push.depths[k])) return;
  const double epsilon = nsvcd__off_meshes(p) + NSVCD__TOO_NEAR * (double)p->given.lengths;
  const double depth = pushed_out + nsvcd__exit_depth(t, n, p->given.clearance, most, epsilon);
  p->push.depths[k] = nsvcd__max(p->push.depths[k], depth);
}

// Does normal k undo a touch? Then its depth is noted.
static int nsvcd__undone_by(nsvcd__proof *p, size_t k, const nsvcd__touch *t) {
  if (!nsvcd__undoes(p, p->push.normals[k], t)) return 0;
  nsvcd__note_depth(p, k, t);
  return 1;
}

// Keeps two triangles that are within the clearance at the start, unless a known direction undoes
// that.
static void nsvcd__collect_contact(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                   const nsvcd__d3 *posed) {
  nsvcd__touch contact;
  memcpy(contact.moving, posed, sizeof contact.moving);
  memcpy(contact.fixed, pair->fixed, sizeof contact.fixed);
  const nsvcd__nearest nearest = nsvcd__nearest_of(posed, pair->fixed);
  const int are_apart = nearest.square > 1e6 * pair->rounding * pair->rounding;
  const nsvcd__d3 distance = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
  contact.directions[0] = nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
  contact.directions[1] = nsvcd__face_direction(pair->fixed);
  contact.directions[2] = nsvcd__d3_scale(distance, are_apart ? 1 / sqrt(nearest.square) : 0);
  for (size_t k = 0; k < p->push.normal_count; k++) {
    if (nsvcd__undone_by(p, k, &contact)) return;
  }
  p->push.too_deep = p->push.too_deep || nsvcd__is_deep(p, &contact);
  if (p->push.contact_count < NSVCD__TOUCHES) p->of.touches[p->push.contact_count++] = contact;
}
#endif  // NSVCD_NO_PROOF
