// In: a question with a slop. Out: the question about a body pushed out of what it touches at the
// start.
//
// What carries a body must not stop it. Which contacts are those? The proof is about the body
// displaced by a vector v that has the slop's length along every normal that it touches at the
// start. That is a motion like any other, and what is proven of it is proven: the displaced body
// stays clear of everything, so the body itself goes no deeper than |v| into anything. There is no
// such v for what presses in deeper than the slop, or is held from opposite sides: that is hit as
// ever. v is constant as the fixed body sees it.
#pragma once
#include "verdict.h"

#ifndef NSVCD_NO_PROOF
// How good a push-out along a direction is.
typedef struct nsvcd__undoing {
  nsvcd__d3 n;
  // Twice how many touches it undoes. A touch counts once if the push-out goes against its faces:
  // what is beyond a face already, or is round and its middle is, would go further in.
  size_t count;
  size_t faces;     // touches with a face of about this normal
  double distance;  // how far it has to go
} nsvcd__undoing;

// Does a push-out along n go against all faces of a touch? A triangle without area has none.
static int nsvcd__is_against(nsvcd__d3 n, const nsvcd__touch *t) {
  int against = 0;
  for (size_t i = 0; i < 2; i++) {
    const int is_face = nsvcd__d3_dot(t->directions[i], t->directions[i]) > 0.5;
    if (is_face && nsvcd__d3_dot(n, t->directions[i]) > -0.3) return 0;
    against |= is_face;
  }
  return against;
}

// Takes a direction, unit, if it is better than the best so far: if it undoes more; of equals, if
// it goes less far; of those that go as far, if more faces have it.
static void nsvcd__try_push_out(const nsvcd__proof *p, nsvcd__d3 n, nsvcd__undoing *best) {
  const double same = nsvcd__epsilon(p) + 0.01 * nsvcd__max(best->distance, 0);
  nsvcd__undoing by = {n, 0, 0, -HUGE_VAL};
  if (best->count > 0 && nsvcd__d3_dot(n, best->n) > 0.99999) return;
  for (size_t k = 0; k < p->push.contact_count; k++) {
    const nsvcd__touch *t = &p->of.touches[k];
    const size_t left = 2 * (p->push.contact_count - k);
    if (by.count + left < best->count) return;
    if (by.count + left == best->count && by.distance > best->distance + same) return;
    if (!nsvcd__undoes(p, n, t)) continue;
    const double distance = nsvcd__depth_along(n, t);
    by.count += distance < 0 && !p->push.by_faces && nsvcd__is_against(n, t) ? 1u : 2u;
    by.faces +=
        nsvcd__d3_dot(n, t->directions[0]) > 0.9 || nsvcd__d3_dot(n, t->directions[1]) > 0.9;
    by.distance = p->push.by_faces ? 0 : nsvcd__max(by.distance, distance);
  }
  if (by.count == 0 || by.count < best->count) return;
  const int is_as_far = by.distance > best->distance - same;
  if (by.count == best->count && by.distance > best->distance + same) return;
  if (by.count == best->count && is_as_far && by.faces <= best->faces) return;
  *best = by;
}

// The best of the normals of all touches and of the directions across an edge of each. Its count is
// 0 if none undoes any touch.
static nsvcd__undoing nsvcd__best_push_out(const nsvcd__proof *p) {
  nsvcd__undoing best = {{0, 0, 0}, 0, 0, HUGE_VAL};
  for (size_t k = 0; k < p->push.contact_count; k++) {
    for (size_t i = 0; i < 3; i++)
      nsvcd__try_push_out(p, p->of.touches[k].directions[i], &best);
  }
  // an edge on an edge
  for (size_t k = 0; k < 9 * p->push.contact_count && best.distance > nsvcd__epsilon(p); k++) {
    const nsvcd__touch *t = &p->of.touches[k / 9];
    const nsvcd__d3 n = nsvcd__across_edges(t->moving, t->fixed, k % 9);
    const nsvcd__d3 out = nsvcd__d3_add(t->directions[0], t->directions[1]);
    const double side = nsvcd__d3_dot(n, out) < 0 ? -1 : 1;
    nsvcd__try_push_out(p, nsvcd__d3_scale(n, side), &best);
  }
  return best;
}

// Finds directions that undo all touches. Returns 0 if nothing undoes one, or it takes too many.
static int nsvcd__choose_push_outs(nsvcd__proof *p) {
  if (p->push.too_deep) return 0;
  while (p->push.contact_count > 0) {
    const size_t k = p->push.normal_count;
    if (k == NSVCD__PUSH_OUTS) return 0;
    const nsvcd__undoing best = nsvcd__best_push_out(p);
    if (best.count == 0) return 0;
    p->push.normals[k] = best.n;
    p->push.depths[k] = 0;
    p->push.normal_count++;
    size_t left = 0;
    for (size_t n = 0; n < p->push.contact_count; n++) {
      if (!nsvcd__undone_by(p, k, &p->of.touches[n])) p->of.touches[left++] = p->of.touches[n];
    }
    p->push.contact_count = left;
  }
  return 1;
}

// Nearly the shortest vector that has at least `least` along all known normals, plus, with
// by_depth, the depth along each: projections onto one half space after another (the relaxation
// method, Agmon 1954). 0 if there is none below four times the longest of these.
static nsvcd__d3 nsvcd__push_out(const nsvcd__push_outs *push, double least, int by_depth) {
  nsvcd__d3 push_out = {0, 0, 0};
  double longest = 0;
  for (size_t round = 0; round < 64; round++) {
    double most = 0;
    for (size_t k = 0; k < push->normal_count; k++) {
      const double along = least + (by_depth ? push->depths[k] : 0);
      const double lacks = along - nsvcd__d3_dot(push_out, push->normals[k]);
      longest = nsvcd__max(longest, along);
      most = nsvcd__max(most, lacks);
      if (lacks > 0)
        push_out = nsvcd__d3_add(push_out, nsvcd__d3_scale(push->normals[k], lacks));
    }
    if (nsvcd__d3_norm(push_out) > 4 * longest) break;
    if (most <= 0.005 * longest) return push_out;
  }
  return nsvcd__d3_of(0, 0, 0);
}

// Pushes a body at rest out of what it touches: by nothing at first, and by more as long as
// something touches. Triangles smaller than the slop can be separated along a wall that their
// neighbours still touch, and there may be too many touches to collect at once: so each push-out is
// tried. If the directions known have no push-out in common, the first one may be wrong, and is
// forgotten, once. Returns 0 if there is no push-out.
static int nsvcd__push_out_still(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *still = goal.motion;
  nsvcd__push_outs *push = &p->push;
  push->normal_count = 0;
  push->needed = 0;
  still->push_out = nsvcd__f3_of(0, 0, 0);
  // Also what is about to touch, or where an earlier motion may have ended, is pushed out of, and
  // may not touch afterwards.
  const double size = (double)p->given.lengths + p->given.radius;
  const double near_by = nsvcd__min(0.05 * push->slop, 0.02 * size);
  double beside = nsvcd__max(near_by, nsvcd__min(p->given.to, 0.5 * push->slop));
  for (int turns = 0;; beside = 0.01 * push->slop) {
    goal.clearance = p->given.clearance + beside + nsvcd__epsilon(p);
    (void)nsvcd__search_anew(w, q, goal);
    if (push->contact_count == 0) return 1;
    const size_t known = push->normal_count;
    if (!nsvcd__choose_push_outs(p) || push->normal_count == known) return 0;
    nsvcd__d3 push_out = nsvcd__push_out(push, push->slop, 0);
    if (!(nsvcd__d3_dot(push_out, push_out) > 0) && turns++ == 0) {
      memmove(push->normals, push->normals + 1, --push->normal_count * sizeof *push->normals);
      memmove(push->depths, push->depths + 1, push->normal_count * sizeof *push->depths);
      push_out = nsvcd__push_out(push, push->slop, 0);
    }
    if (!(nsvcd__d3_dot(push_out, push_out) > 0)) return 0;
    still->push_out = nsvcd__f3_round(push_out);
  }
}

// Makes the depths known as exact as need be. What is not in touch at the start may be where the
// body is pushed out to, and not all touches may have been collected. So the body is pushed out by
// little more than the known depths, to see what it touches there, until nothing does. Triangles
// that follow each other, as on a slope, each come free soon: so the little more doubles as long as
// depths grow.
static void nsvcd__deepen(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *still = goal.motion;
  const nsvcd__f3 push_out = still->push_out;
  const double least_more = 0.5 * nsvcd__epsilon(p);
  double more = least_more;
  double before = 0;
  goal.clearance = p->given.clearance;
  for (size_t k = 0; k < p->push.normal_count; k++) before += p->push.depths[k];
  for (int round = 0; round < NSVCD__DEEPEN; round++) {
    double after = 0;
    still->push_out = nsvcd__f3_round(nsvcd__push_out(&p->push, more, 1));
    (void)nsvcd__search_anew(w, q, goal);
    // A touch gets out of the way along the normal that undoes it first, even if no plane normal to
    // that separates it.
    for (size_t n = 0; n < p->push.contact_count; n++) {
      const nsvcd__touch *t = &p->of.touches[n];
      size_t best = 0;
      double least = HUGE_VAL;
      for (size_t k = 0; k < p->push.normal_count; k++) {
        const double distance = nsvcd__depth_along(p->push.normals[k], t);
        if (distance < least) best = k;
        least = nsvcd__min(least, distance);
      }
      nsvcd__note_depth(p, best, t);
    }
    for (size_t k = 0; k < p->push.normal_count; k++) after += p->push.depths[k];
    const int is_deeper = after > before;
    if (!is_deeper && more <= nsvcd__max(least_more, 0.002 * after)) break;
    more = is_deeper ? 2 * more : nsvcd__max(least_more, 0.125 * more);
    before = after;
  }
  still->push_out = push_out;
}

// Pushes the motion out of what it touches at its start, by the slop; or, if something is in the
// way of that and nothing is too deep, by what is needed.
static NSVCD__NOINLINE void nsvcd__push_out_motion(nsvcd__solver *w, nsvcd__search *q,
                                                   nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *whole = goal.motion;
  nsvcd__motion start = nsvcd__end_of(whole, 0);
  goal.motion = &start;
  goal.collects = NSVCD__TOUCHING;
  p->push.slop = p->given.slop;
  p->push.by_faces = 0;
  int is_free = nsvcd__push_out_still(w, q, goal);
  if (!is_free && !p->push.too_deep) {
    // The shortest push-outs may not go together.
    p->push.by_faces = 1;
    is_free = nsvcd__push_out_still(w, q, goal);
  }
  const double least = 1.1 * p->push.needed + 4 * nsvcd__epsilon(p);
  if (!is_free && p->push.contact_count == 0 && least < 0.9 * p->given.slop) {
    p->push.slop = least;
    is_free = nsvcd__push_out_still(w, q, goal);
  }
  if (is_free && p->push.normal_count > 0) nsvcd__deepen(w, q, goal);
  whole->push_out = is_free ? start.push_out : nsvcd__f3_of(0, 0, 0);
  nsvcd__restart(w, whole);
}
#endif  // NSVCD_NO_PROOF
