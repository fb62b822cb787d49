// In: a contact, and the motion that led to it. Out: its normal.
//
// Just before two triangles meet, the direction between their nearest points is one along which
// they are separated still: of all that are left at the contact, the one most against the motion.
// Where a corner comes to a face it is the face's normal, on the side that the corner comes from;
// where an edge crosses an edge, across both; where a corner comes to a corner, against the motion.
// A contact may be found a little after they have met: so one of them is taken back, as fast as the
// contact point goes, until they are separated. Where they have been in touch from the start the
// motion tells nothing: then it is the direction along which they are the least deep.
//
// Triangles within the clearance that do not meet have a direction: their nearest points'. It is
// along the motion only if they have been nearer, and then the contact is moved to before that.
#pragma once
#include "verdict.h"

#ifndef NSVCD_NO_PROOF
// The arc that is under way at a time counted in ticks or, where that is told as a keyframe, ends
// there: what comes to a contact comes by that one.
static const nsvcd__arc *nsvcd__arc_before(nsvcd__proof *p, double tick, double *u) {
  uint32_t first = nsvcd__arc_of(p->ask.motion, tick, u);
  if (first > 0 && tick - (double)first < 6e-8 * (double)p->ask.motion->ticks) {
    first = nsvcd__arc_of(p->ask.motion, (double)first - 0.5, u);
    *u = 1;
  }
  return nsvcd__arc_at(p, first);
}

// The triangles of a contact at a time, and how the bodies go then.
typedef struct nsvcd__approach {
  nsvcd__triangle_pair pair;
  nsvcd__triangle_contact contact;
  nsvcd__twist twist;
  double u;
} nsvcd__approach;

static NSVCD__NOINLINE void nsvcd__approach_at(nsvcd__proof *p,
                                               const nsvcd__pair_contact *found, double tick,
                                               nsvcd__approach *out) {
  const nsvcd__arc *arc = nsvcd__arc_before(p, tick, &out->u);
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, out->u);
  out->pair = nsvcd__pair_of(p, found->moving_patch, found->fixed_patch, found->moving_entry,
                             found->fixed_entry);
  nsvcd__pose_triangle(&at, out->pair.moving, out->contact.moving);
  memcpy(out->contact.fixed, out->pair.fixed, sizeof out->contact.fixed);
  out->contact.directions[0] = nsvcd__d3_scale(nsvcd__face_direction(out->contact.moving), -1);
  out->contact.directions[1] = nsvcd__face_direction(out->contact.fixed);
  out->twist = nsvcd__twist_at(arc, out->u);
}

// Do two points come apart?
static int nsvcd__recede(const nsvcd__twist *twist, const nsvcd__nearest *points) {
  const nsvcd__d3 apart = nsvcd__d3_sub(points->on_a, points->on_b);
  const nsvcd__d3 speed = nsvcd__twist_of(twist, points->on_b);
  return nsvcd__d3_dot(speed, apart) > 0;
}

// Moves a contact to an earlier time, from `since` on, when its triangles were as near and did not
// come apart; or, if they meet, to when they began to. Where they were in touch then, and have come
// apart all the while, it stays.
static NSVCD__NOINLINE void nsvcd__turn_back(nsvcd__proof *p, double since) {
  nsvcd__pair_contact *found = &p->known.found;
  nsvcd__pair_contact sooner = *found;
  double early = since;
  double late = found->tick;
  double tick = late;
  for (size_t k = 0; k < NSVCD__HALVINGS && early < late; k++) {
    nsvcd__approach then;
    nsvcd__approach_at(p, found, tick, &then);
    const nsvcd__nearest nearest = nsvcd__nearest_of(then.contact.moving, then.contact.fixed);
    const double gap = sqrt(nearest.square);
    const int are_near = k == 0 || gap <= found->distance + then.pair.rounding;
    const int nearing = gap > then.pair.rounding && !nsvcd__recede(&then.twist, &nearest);
    if (are_near && k > 0) sooner = nsvcd__contact_at(p, &then.pair, then.u, &nearest);
    if (are_near && nearing) break;
    *(are_near ? &late : &early) = tick;
    tick = k == 0 ? early : 0.5 * (early + late);
  }
  if (early < late) *found = sooner;
}

// The directions along which two triangles that touch may be separated: two normals and nine
// products of edges, both ways. 0: none.
enum { NSVCD__AXES = 22 };
static nsvcd__d3 nsvcd__axis_apart(const nsvcd__triangle_contact *t, size_t k) {
  const nsvcd__d3 n =
      k < 4 ? t->directions[1 - k / 2] : nsvcd__across_edges(t->moving, t->fixed, k / 2 - 2);
  return nsvcd__d3_scale(n, k % 2 ? -1 : 1);
}

// The direction at which two triangles met that touch, if the moving one came straight along so
// much of `direction` or less. 0: it did not. Nearer than they are known it cannot be told which of
// them a corner met: so it is that a little before.
static NSVCD__NOINLINE int nsvcd__met_along(const nsvcd__proof *p, const nsvcd__approach *a,
                                            nsvcd__d3 direction, double most,
                                            nsvcd__d3 *normal) {
  const nsvcd__triangle_contact *t = &a->contact;
  const double close = 16 * nsvcd__epsilon(p) / nsvcd__d3_length(direction);
  double back = HUGE_VAL;  // where they met, as a share of the way
  double before = 0;
  nsvcd__d3 moved[3];
  for (size_t k = 0; k < NSVCD__AXES; k++) {
    const nsvcd__d3 n = nsvcd__axis_apart(t, k);
    const double fall = -nsvcd__d3_dot(n, direction);
    const double deep = nsvcd__push_out_along(n, t);
    if (!(fall > 0) || !(deep < back * fall)) continue;
    back = deep / fall;
    before = nsvcd__max(close, 1e4 * a->pair.rounding / fall);
    *normal = n;
  }
  if (!(back < most)) return 0;
  const nsvcd__d3 off = nsvcd__d3_scale(direction, back + before);
  for (int n = 0; n < 3; n++) moved[n] = nsvcd__d3_sub(t->moving[n], off);
  const nsvcd__nearest nearest = nsvcd__nearest_of(moved, t->fixed);
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
  if (nsvcd__d3_dot(apart, direction) < 0) *normal = nsvcd__d3_unit(apart, *normal);
  return 1;
}

// The direction along which two triangles that touch are the least deep in each other; of several
// the one most against `direction`. A face of a closed surface has one side, and no direction is
// against both faces.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__shallowest(const nsvcd__proof *p,
                                                   const nsvcd__approach *a,
                                                   nsvcd__d3 direction) {
  const int moving_closed = nsvcd__moving_closed(p, &a->pair);
  const int fixed_closed = nsvcd__fixed_closed(p, &a->pair);
  const nsvcd__triangle_contact *t = &a->contact;
  const double same = 1e4 * a->pair.rounding;
  nsvcd__d3 best = t->directions[1];
  double least = HUGE_VAL;
  for (size_t k = 0; k < NSVCD__AXES; k++) {
    const nsvcd__d3 n = nsvcd__axis_apart(t, k);
    const int out_of_a = !moving_closed || nsvcd__d3_dot(n, t->directions[0]) >= -1e-9;
    const int out_of_b = !fixed_closed || nsvcd__d3_dot(n, t->directions[1]) >= -1e-9;
    int is_out = out_of_a || out_of_b;
    if (k < 4) is_out = k < 2 ? out_of_b : out_of_a;
    if (!is_out || !(nsvcd__d3_dot(n, n) > 0.5)) continue;
    const double depth = nsvcd__push_out_along(n, t);
    const double more = nsvcd__d3_dot(nsvcd__d3_sub(best, n), direction);
    if (depth > least - same && !(depth < least + same && more > 0)) continue;
    best = n;
    least = nsvcd__min(least, depth);
  }
  return best;
}

// The direction at which the triangles of the contact that is known met, if they did not before
// `since`; or, if they were free of each other then, at some time.
static int nsvcd__normal_met(nsvcd__proof *p, double since, int is_free,
                             nsvcd__approach *now) {
  nsvcd__pair_contact *found = &p->known.found;
  nsvcd__approach_at(p, found, found->tick, now);
  const nsvcd__d3 speed = nsvcd__twist_of(&now->twist, found->point);
  const nsvcd__d3 direction = nsvcd__d3_scale(speed, found->tick - since);
  return nsvcd__met_along(p, now, direction, is_free ? HUGE_VAL : 1, &found->normal);
}

// Do two times, in ticks, fall into different arcs?
static int nsvcd__has_turned(const nsvcd__proof *p, double since, double until) {
  double u;
  const uint32_t first = nsvcd__arc_of(p->ask.motion, since, &u);
  return first != nsvcd__arc_of(p->ask.motion, until, &u);
}

// Gives the contact that is known its normal.
static NSVCD__NOINLINE void nsvcd__resolve_normal(nsvcd__proof *p) {
  nsvcd__pair_contact *found = &p->known.found;
  const double until = nsvcd__max(nsvcd__min(nsvcd__clear_until(p), found->tick), 0);
  const double since = p->given.fraction > 0 ? until : 0;
  const int is_free = since > 0 || (p->given.fraction > 0 && p->starts_free);
  nsvcd__approach now;
  // what comes to a pose and goes back may have been found on the way back
  const int has_turned = is_free && nsvcd__has_turned(p, since, found->tick);
  if (found->distance > 0 || has_turned) nsvcd__turn_back(p, since);
  if (found->distance > 0) return;
  if (has_turned && nsvcd__has_turned(p, since, found->tick)) {
    // these met on the way back alone: but others of the bodies on the way there
    nsvcd__approach_at(p, found, since, &now);
    const nsvcd__nearest nearest = nsvcd__nearest_of(now.contact.moving, now.contact.fixed);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    found->normal = nsvcd__d3_unit(apart, found->normal);
    return;
  }
  if (nsvcd__normal_met(p, since, 0, &now)) return;
  if (is_free) {
    // it has turned since, and they may come apart again
    nsvcd__turn_back(p, since);
    if (nsvcd__normal_met(p, since, 1, &now)) return;
  }
  const nsvcd__d3 speed = nsvcd__twist_of(&now.twist, found->point);
  found->normal = nsvcd__shallowest(p, &now, speed);
}
#endif  // NSVCD_NO_PROOF
