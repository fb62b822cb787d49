// In: a contact, and the motion that led to it. Out: its normal.
//
// Just before two triangles meet, the direction between their nearest points still separates them:
// of all directions left at the contact, it is the one most against the motion. Where a corner
// comes to a face it is the face's normal, on the side that the corner comes from; where an edge
// crosses an edge, across both; where a corner comes to a corner, against the motion. A contact may
// be found a little after they have met: so one triangle is moved back, with the contact point's
// velocity, until they are separated. If they have touched from the start, the motion tells
// nothing: then it is the direction along which they are the least deep.
//
// Triangles within the clearance that do not meet have a direction: their nearest points'. It is
// along the motion only if they have been nearer, and then the contact is moved to before that.
#pragma once
#include "verdict.h"

#ifndef NSVCD_NO_PROOF
static nsvcd__d3 nsvcd__twist_of(const nsvcd__twist *twist, nsvcd__d3 x) {
  return nsvcd__d3_add(twist->along, nsvcd__d3_cross(twist->turn, x));
}

// Are these of closed surfaces, whose winding says which side is out?
static int nsvcd__moving_closed(const nsvcd__proof *p, const nsvcd__triangle_pair *c) {
  return nsvcd__is_in_solid(&p->moving, c->moving_patch, c->moving_entry);
}
static int nsvcd__fixed_closed(const nsvcd__proof *p, const nsvcd__triangle_pair *c) {
  return nsvcd__is_in_solid(&p->fixed, c->fixed_patch, c->fixed_entry);
}

// The moving body's twist there, as the fixed body sees it.
static nsvcd__twist nsvcd__twist_at(const nsvcd__arc *arc, double u) {
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, u);
  const double per_tick = 1 / (double)arc->ticks;
  const nsvcd__dmat3 fixed = nsvcd__dmat3_of(nsvcd__slerp_at(&arc->fixed, u));
  nsvcd__d3 turn = nsvcd__slerp_turn(&arc->moving);
  nsvcd__d3 own = nsvcd__slerp_turn(&arc->fixed);
  turn = nsvcd__dmat3_apply_transpose(&fixed, turn);
  own = nsvcd__dmat3_apply_transpose(&fixed, own);
  // the moving body's pivot, as it moves; with what is added, the fixed body turns about its own
  const nsvcd__d3 arm = nsvcd__dmat3_apply(&at.rotation, arc->pivot);
  const nsvcd__d3 pivot = nsvcd__d3_fma(1 / arc->scale, arm, at.position);
  nsvcd__d3 along = nsvcd__dmat3_apply_transpose(&fixed, arc->moved);
  along = nsvcd__d3_add(along, nsvcd__d3_cross(own, arc->added));
  along = nsvcd__d3_sub(along, nsvcd__d3_cross(turn, pivot));
  nsvcd__twist out;
  out.along = nsvcd__d3_scale(along, per_tick);
  out.turn = nsvcd__d3_scale(nsvcd__d3_sub(turn, own), per_tick);
  return out;
}

// The arc of a time in ticks; at a keyframe, the arc that ends there: by that one the body came to
// the contact.
static const nsvcd__arc *nsvcd__arc_before(nsvcd__arcs *arcs, double tick, double *u) {
  uint32_t first = nsvcd__arc_of(arcs->motion, tick, u);
  if (first > 0 && tick - (double)first < 6e-8 * (double)arcs->motion->ticks) {
    first = nsvcd__arc_of(arcs->motion, (double)first - 0.5, u);
    *u = 1;
  }
  return nsvcd__arc_at(arcs, first);
}

// The triangles of a contact at a time, and how the bodies move then.
typedef struct nsvcd__approach {
  nsvcd__triangle_pair pair;
  nsvcd__touch contact;
  nsvcd__twist twist;
  double u;
} nsvcd__approach;

static NSVCD__NOINLINE void nsvcd__approach_at(nsvcd__proof *p,
                                               const nsvcd__pair_contact *found, double tick,
                                               nsvcd__approach *out) {
  const nsvcd__arc *arc = nsvcd__arc_before(&p->arcs, tick, &out->u);
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, out->u);
  out->pair = nsvcd__pair_of(p, found->moving_patch, found->fixed_patch, found->moving_entry,
                             found->fixed_entry);
  nsvcd__pose_triangle(&at, out->pair.moving, out->contact.moving);
  memcpy(out->contact.fixed, out->pair.fixed, sizeof out->contact.fixed);
  out->contact.directions[0] = nsvcd__d3_scale(nsvcd__face_direction(out->contact.moving), -1);
  out->contact.directions[1] = nsvcd__face_direction(out->contact.fixed);
  out->twist = nsvcd__twist_at(arc, out->u);
}

// Moves a contact to an earlier time, from `since` on, when its triangles were as near and did not
// come apart; if they meet, to when they began to. It stays if they touched at `since` and have
// come apart ever since.
static NSVCD__NOINLINE void nsvcd__move_back(nsvcd__proof *p, nsvcd__pair_contact *found,
                                             double since) {
  nsvcd__pair_contact sooner = *found;
  double early = since;
  double late = found->tick;
  double tick = late;
  for (size_t k = 0; k < NSVCD__HALVINGS && early < late; k++) {
    nsvcd__approach then;
    nsvcd__approach_at(p, found, tick, &then);
    const nsvcd__nearest nearest = nsvcd__nearest_of(then.contact.moving, then.contact.fixed);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    const nsvcd__d3 speed = nsvcd__twist_of(&then.twist, nearest.on_b);
    const double gap = sqrt(nearest.square);
    const int are_near = k == 0 || gap <= found->distance + then.pair.rounding;
    const int nearing = gap > then.pair.rounding && !(nsvcd__d3_dot(speed, apart) > 0);
    if (are_near && k > 0) sooner = nsvcd__contact_at(p, &then.pair, then.u, &nearest);
    if (are_near && nearing) break;
    *(are_near ? &late : &early) = tick;
    tick = k == 0 ? early : 0.5 * (early + late);
  }
  if (early < late) *found = sooner;
}

// The separating axes of two triangles that touch: two normals and nine products of edges, both
// ways. 0: edges are parallel.
enum { NSVCD__AXES = 22 };
static nsvcd__d3 nsvcd__axis_apart(const nsvcd__touch *t, size_t k) {
  const nsvcd__d3 n =
      k < 4 ? t->directions[1 - k / 2] : nsvcd__across_edges(t->moving, t->fixed, k / 2 - 2);
  return nsvcd__d3_scale(n, k % 2 ? -1 : 1);
}

// The normal at which two triangles met that touch, if the moving one came straight along `travel`,
// by `most` times that at most. 0: it did not. Nearer than the triangles are known, nothing tells
// which of them a corner met: so it is the normal a little before.
static NSVCD__NOINLINE int nsvcd__met_along(const nsvcd__proof *p, const nsvcd__approach *a,
                                            nsvcd__d3 travel, double most, nsvcd__d3 *normal) {
  const nsvcd__touch *t = &a->contact;
  const double close = 16 * nsvcd__epsilon(p) / nsvcd__d3_norm(travel);
  double back = HUGE_VAL;  // where they met, as a fraction of `travel`
  double before = 0;
  nsvcd__d3 moved[3];
  for (size_t k = 0; k < NSVCD__AXES; k++) {
    const nsvcd__d3 n = nsvcd__axis_apart(t, k);
    const double fall = -nsvcd__d3_dot(n, travel);
    const double deep = nsvcd__depth_along(n, t);
    if (!(fall > 0) || !(deep < back * fall)) continue;
    back = deep / fall;
    before = nsvcd__max(close, 1e4 * a->pair.rounding / fall);
    *normal = n;
  }
  if (!(back < most)) return 0;
  const nsvcd__d3 off = nsvcd__d3_scale(travel, back + before);
  for (int n = 0; n < 3; n++) moved[n] = nsvcd__d3_sub(t->moving[n], off);
  const nsvcd__nearest nearest = nsvcd__nearest_of(moved, t->fixed);
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
  if (nsvcd__d3_dot(apart, travel) < 0) *normal = nsvcd__d3_unit(apart, *normal);
  return 1;
}

// The direction along which two triangles that touch are the least deep in each other; of several
// the one most against `travel`. A face of a closed surface has one side, and the direction is not
// against both faces.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__shallowest(const nsvcd__proof *p,
                                                   const nsvcd__approach *a,
                                                   nsvcd__d3 travel) {
  const int moving_closed = nsvcd__moving_closed(p, &a->pair);
  const int fixed_closed = nsvcd__fixed_closed(p, &a->pair);
  const nsvcd__touch *t = &a->contact;
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
    const double depth = nsvcd__depth_along(n, t);
    const double more = nsvcd__d3_dot(nsvcd__d3_sub(best, n), travel);
    if (depth > least - same && !(depth < least + same && more > 0)) continue;
    best = n;
    least = nsvcd__min(least, depth);
  }
  return best;
}

// The normal at which the triangles of the known contact met, if that was after `since`, or, if
// they were free of each other then, at any time. 0: it was not.
static int nsvcd__normal_met(nsvcd__proof *p, nsvcd__pair_contact *found, double since,
                             int is_free, nsvcd__approach *now) {
  nsvcd__approach_at(p, found, found->tick, now);
  const nsvcd__d3 speed = nsvcd__twist_of(&now->twist, found->point);
  const nsvcd__d3 travel = nsvcd__d3_scale(speed, found->tick - since);
  return nsvcd__met_along(p, now, travel, is_free ? HUGE_VAL : 1, &found->normal);
}

// Are two times, in ticks, in different arcs?
static int nsvcd__has_turned(const nsvcd__proof *p, double since, double until) {
  double u;
  const uint32_t first = nsvcd__arc_of(p->arcs.motion, since, &u);
  return first != nsvcd__arc_of(p->arcs.motion, until, &u);
}

// Gives the known contact its normal.
static NSVCD__NOINLINE void nsvcd__resolve_normal(nsvcd__proof *p, double clear_until,
                                                  nsvcd__search_result *result) {
  nsvcd__pair_contact *found = &result->found;
  const double until = nsvcd__max(nsvcd__min(clear_until, found->tick), 0);
  const double since = p->given.fraction > 0 ? until : 0;
  const int is_free = since > 0 || (p->given.fraction > 0 && result->starts_free);
  nsvcd__approach now;
  // What comes to a pose and goes back may have been found on its way back.
  const int has_turned = is_free && nsvcd__has_turned(p, since, found->tick);
  if (found->distance > 0 || has_turned) nsvcd__move_back(p, found, since);
  if (found->distance > 0) return;
  if (has_turned && nsvcd__has_turned(p, since, found->tick)) {
    // These met on the way back alone, but others did on the way there.
    nsvcd__approach_at(p, found, since, &now);
    const nsvcd__nearest nearest = nsvcd__nearest_of(now.contact.moving, now.contact.fixed);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    found->normal = nsvcd__d3_unit(apart, found->normal);
    return;
  }
  if (nsvcd__normal_met(p, found, since, 0, &now)) return;
  if (is_free) {
    // The motion has turned since, and they may come apart again.
    nsvcd__move_back(p, found, since);
    if (nsvcd__normal_met(p, found, since, 1, &now)) return;
  }
  const nsvcd__d3 speed = nsvcd__twist_of(&now.twist, found->point);
  found->normal = nsvcd__shallowest(p, &now, speed);
}
#endif  // NSVCD_NO_PROOF
