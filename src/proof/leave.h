// In: a question with a skin. Out: the question about a body lifted off what it touches at the
// start.
//
// What carries a body must not stop it. Which contacts are those? The body is asked about as if it
// were lifted off all that it touches at the start, by a vector v that has the skin's length along
// every normal there. That is a motion like any other, and what is proven of it is proven: the body
// stays clear of everything when displaced by v, so that, undisplaced, it goes no deeper than |v|
// into anything. What presses in deeper than the skin at the start has no such v, nor has what is
// held from opposite sides, and is hit as ever. v is constant as the fixed body sees it.
#pragma once
#include "verdict.h"

#ifndef NSVCD_NO_PROOF
// How good a lift along n is: the more touches it undoes the better; of equals, the more of
// these have a face that says so. 0 if it undoes none.
static double nsvcd__undone(const nsvcd__proof *p, nsvcd__d3 n) {
  double count = 0;
  double faces = 0;
  for (size_t k = 0; k < p->touch_count; k++) {
    const nsvcd__touch *t = &p->of.touches[k];
    nsvcd__d3 normals[3];
    if (!nsvcd__undoes(p, n, t)) continue;
    nsvcd__touch_normals(t, normals);
    count++;
    faces += nsvcd__d3_dot(n, normals[0]) > 0.9 || nsvcd__d3_dot(n, normals[1]) > 0.9;
  }
  return count * (NSVCD__TOUCHES + 2) + faces;
}

// Takes a direction that is better than the best so far.
static NSVCD__APART void nsvcd__try_lift(const nsvcd__proof *p, nsvcd__d3 n, double *most,
                                         nsvcd__d3 *best) {
  const int known = *most > 0 && nsvcd__d3_dot(n, *best) > 0.99999;
  const double good = known ? 0 : nsvcd__undone(p, n);
  if (good > *most) *best = n;
  *most = fmax(*most, good);
}

// Of the normals of what touches, and the directions across an edge of each, the one that undoes
// the most touches: *best, as it was if none undoes any: then 0 is returned.
static int nsvcd__best_lift(const nsvcd__proof *p, nsvcd__d3 *best) {
  double most = 0;
  for (size_t k = 0; k < p->touch_count; k++) {
    nsvcd__d3 normals[3];
    nsvcd__touch_normals(&p->of.touches[k], normals);
    for (size_t i = 0; i < 3; i++) nsvcd__try_lift(p, normals[i], &most, best);
  }
  // an edge on an edge
  for (size_t k = 0; k < 9 && !(most > 0); k++) {
    const nsvcd__touch *t = &p->of.touches[0];
    const nsvcd__d3 u = nsvcd__d3_sub(t->moving[(k + 1) % 3], t->moving[k % 3]);
    const nsvcd__d3 v = nsvcd__d3_sub(t->fixed[(k / 3 + 1) % 3], t->fixed[k / 3]);
    const nsvcd__d3 n = nsvcd__d3_unit(nsvcd__d3_cross(u, v), nsvcd__d3_of(0, 0, 0));
    nsvcd__d3 normals[3];
    nsvcd__touch_normals(t, normals);
    const double side = nsvcd__d3_dot(n, nsvcd__d3_add(normals[0], normals[1])) < 0 ? -1 : 1;
    nsvcd__try_lift(p, nsvcd__d3_scale(n, side), &most, best);
  }
  return most > 0;
}

// Finds directions that undo all that was gathered. 0: there are none for something, or too many.
static int nsvcd__choose_lifts(nsvcd__proof *p) {
  while (p->touch_count > 0) {
    nsvcd__d3 best = {0, 0, 0};
    if (p->normal_count == NSVCD__LIFTS || !nsvcd__best_lift(p, &best)) return 0;
    p->normals[p->normal_count++] = best;
    size_t left = 0;
    for (size_t k = 0; k < p->touch_count; k++) {
      if (!nsvcd__undoes(p, best, &p->of.touches[k])) p->of.touches[left++] = p->of.touches[k];
    }
    p->touch_count = left;
  }
  return 1;
}

// The shortest vector, nearly, that has the skin's length along all normals that were gathered. 0
// if there is none of less than four skins.
static nsvcd__d3 nsvcd__lift_off(const nsvcd__proof *p) {
  nsvcd__d3 lift = {0, 0, 0};
  for (size_t round = 0; round < 64; round++) {
    double most = 0;
    for (size_t k = 0; k < p->normal_count; k++) {
      const double lacks = p->given.skin - nsvcd__d3_dot(lift, p->normals[k]);
      most = fmax(most, lacks);
      if (lacks > 0) lift = nsvcd__d3_add(lift, nsvcd__d3_scale(p->normals[k], lacks));
    }
    if (nsvcd__d3_length(lift) > 4 * p->given.skin) break;
    if (most <= 0.01 * p->given.skin) return lift;
  }
  return nsvcd__d3_of(0, 0, 0);
}

// Lifts the motion off what it touches at its start: by nothing at first, and whenever something
// touches at the start so lifted, by more, until nothing does. Triangles smaller than the skin can
// be parted along a wall that others of them stay in touch with, and there may be too many touches
// to look at together: so what has been found is tried. If there is no way off all that was found,
// then what was found first may have been the wrong way, and is forgotten, once.
static NSVCD__APART void nsvcd__lift_motion(nsvcd__proof *p, nsvcd__search *search) {
  nsvcd__motion *whole = p->ask.motion;
  nsvcd__motion start = nsvcd__end_of(whole, 0);
  p->ask.motion = &start;
  p->normal_count = 0;
  // what is about to touch is lifted off too, and may not touch afterwards
  const float quanta = p->ask.motion->scale * nsvcd__widest_quantum(&p->moving);
  const double hair = (double)(quanta + nsvcd__widest_quantum(&p->fixed));
  p->ask.clearance = p->given.clearance + 0.05 * p->given.skin + hair;
  p->ask.gathers = 1;
  for (int turns = 0, more = 1; more;) {
    p->touch_count = 0;
    (void)nsvcd__prove_anew(p, search);
    if (p->touch_count == 0) break;
    const size_t known = p->normal_count;
    more = nsvcd__choose_lifts(p) && p->normal_count > known;
    nsvcd__d3 lift = nsvcd__lift_off(p);
    if (more && !(nsvcd__d3_dot(lift, lift) > 0) && turns++ == 0) {
      memmove(p->normals, p->normals + 1, --p->normal_count * sizeof *p->normals);
      lift = nsvcd__lift_off(p);
    }
    more &= nsvcd__d3_dot(lift, lift) > 0;
    start.lift = more ? nsvcd__f3_round(lift) : nsvcd__f3_of(0, 0, 0);
    p->ask.clearance = p->given.clearance + 0.01 * p->given.skin + hair;
  }
  p->ask.gathers = 0;
  p->ask.clearance = p->given.clearance;
  p->ask.motion = whole;
  whole->lift = start.lift;
  nsvcd__proof_restart(p);
}
#endif  // NSVCD_NO_PROOF
