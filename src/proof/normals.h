// In: a contact, and since when its triangles have not been in touch. Out: its normal.
//
// Just before two triangles meet, the direction between their nearest points is one along which they
// are still separated: of all those that are left at the contact, the one most against the motion.
// So where a corner comes to a face it is the face's normal, on the side that the corner comes from;
// where an edge crosses an edge, across both; where a corner comes to a corner, against the motion.
// A contact may be found a little after triangles have met: so one is taken back along the speed of
// the contact point until they are separated, and the direction is that at which they meet. Where
// they have been in touch from the start the motion tells nothing: then it is the direction along
// which they are the least deep.
//
// Triangles within the clearance that do not meet have a direction: their nearest points'. It is
// along the motion only if they have been nearer, and then the contact is moved to before that.
#pragma once
#include "witnesses.h"

#ifndef NSVCD_NO_PROOF
// The arc that is under way at a time counted in ticks or, at a knot, that ends there: what comes to
// a contact comes by that one.
static const nsvcd__arc *nsvcd__arc_before(nsvcd__proof *p, double tick, double *u) {
  uint32_t first = nsvcd__arc_of(p->ask.motion, tick, u);
  if (!(*u > 0) && first > 0) {
    first = nsvcd__arc_of(p->ask.motion, (double)first - 0.5, u);
    *u = 1;
  }
  return nsvcd__arc_at(p, first);
}

// The triangles of a contact at a time.
typedef struct nsvcd__approach {
  nsvcd__couple couple;
  double u;
  nsvcd__touch touch;
  nsvcd__nearest nearest;
  nsvcd__twist twist;
} nsvcd__approach;

static NSVCD__APART void nsvcd__approach_at(nsvcd__proof *p, const nsvcd__contact *found,
                                            double tick, nsvcd__approach *out) {
  const nsvcd__arc *arc = nsvcd__arc_before(p, tick, &out->u);
  const nsvcd__placement at = nsvcd__placement_at(arc, out->u);
  out->couple = nsvcd__couple_of(p, found->moving_patch, found->fixed_patch,
                                 found->moving_listing, found->fixed_listing);
  nsvcd__place_triangle(&at, out->couple.moving, out->touch.moving);
  memcpy(out->touch.fixed, out->couple.fixed, sizeof out->touch.fixed);
  out->touch.ways[0] = nsvcd__d3_scale(nsvcd__face_direction(out->touch.moving), -1);
  out->touch.ways[1] = nsvcd__face_direction(out->touch.fixed);
  out->nearest = nsvcd__nearest_of(out->touch.moving, out->touch.fixed);
  out->twist = nsvcd__twist_at(arc, out->u);
}

// Do the nearest points of two triangles come apart?
static int nsvcd__recedes(const nsvcd__approach *a) {
  const nsvcd__d3 apart = nsvcd__d3_sub(a->nearest.on_a, a->nearest.on_b);
  return nsvcd__d3_dot(nsvcd__twist_of(&a->twist, a->nearest.on_b), apart) > 0;
}

// The direction at which two triangles meet that touch, if the moving one comes straight along
// `way`, of which it has gone all, or, if they were free before, more. The distance is convex on
// it: Newton's method, from where they are apart, comes to where they meet, and never past it. 0:
// they are in touch all the way.
static NSVCD__APART int nsvcd__met_along(const nsvcd__touch *t, nsvcd__d3 way, int is_free,
                                         double margin, nsvcd__d3 *normal) {
  double back = 1;
  int known = 0;
  for (size_t k = 0; k < NSVCD__HALVINGS; k++) {
    nsvcd__d3 moved[3];
    for (int n = 0; n < 3; n++)
      moved[n] = nsvcd__d3_sub(t->moving[n], nsvcd__d3_scale(way, back));
    const nsvcd__nearest nearest = nsvcd__nearest_of(moved, t->fixed);
    const double distance = sqrt(nearest.square);
    if (!(distance > margin)) {
      if (known || !is_free) return known;
      back *= 2;
      continue;
    }
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    const nsvcd__d3 n = nsvcd__d3_scale(apart, 1 / distance);
    const double fall = -nsvcd__d3_dot(n, way);
    if (!(fall > 0)) return known;
    *normal = n;
    known = 1;
    back -= distance / fall;
  }
  return known;
}

// The direction along which two triangles that touch are the least deep in each other; of several
// the one most against `way`. A face of a closed surface has one side, and no direction is against
// both faces.
static NSVCD__APART nsvcd__d3 nsvcd__shallowest(const nsvcd__touch *t, const int *closed,
                                                nsvcd__d3 way, double margin) {
  nsvcd__d3 best = t->ways[1];
  double least = HUGE_VAL;
  for (size_t k = 0; k < 22; k++) {
    const size_t axis = k / 2;
    const nsvcd__d3 out = axis < 2 ? t->ways[1 - axis] : nsvcd__across_edges(t, axis - 2);
    const nsvcd__d3 n = nsvcd__d3_scale(out, k % 2 ? -1 : 1);
    const int against_moving = closed[0] && nsvcd__d3_dot(n, t->ways[0]) < -1e-9;
    const int against_fixed = closed[1] && nsvcd__d3_dot(n, t->ways[1]) < -1e-9;
    if (!(nsvcd__d3_dot(n, n) > 0.5) || (against_moving && against_fixed)) continue;
    if (k % 2 && axis < 2 && closed[1 - axis]) continue;
    const double depth = nsvcd__lift_along(n, t);
    const double more = nsvcd__d3_dot(nsvcd__d3_sub(best, n), way);
    const int is_same = depth < least + margin && more > 0;
    if (!(depth < least - margin || is_same)) continue;
    best = n;
    least = nsvcd__min(least, depth);
  }
  return best;
}

// Gives the contact that is known its normal. since: ticks; were they free of each other then?
static NSVCD__APART void nsvcd__settle_normal(nsvcd__proof *p, double since, int is_free) {
  nsvcd__contact *found = &p->known.found;
  nsvcd__approach now;
  nsvcd__approach_at(p, found, found->tick, &now);
  if (found->distance > now.couple.rounding && found->tick > since && nsvcd__recedes(&now)) {
    nsvcd__approach then;
    double early = since;
    double late = found->tick;
    nsvcd__approach_at(p, found, early, &then);
    int is_early = sqrt(then.nearest.square) > found->distance || !nsvcd__recedes(&then);
    for (size_t k = 0; is_early && k < NSVCD__HALVINGS; k++) {
      const double middle = 0.5 * (early + late);
      nsvcd__approach_at(p, found, middle, &then);
      const int is_apart = sqrt(then.nearest.square) > found->distance;
      *(!is_apart && nsvcd__recedes(&then) ? &late : &early) = middle;
      if (is_apart || nsvcd__recedes(&then)) continue;
      *found = nsvcd__contact_at(p, &then.couple, then.u, &then.nearest);
      now = then;
      is_early = 0;
    }
  }
  if (found->distance > now.couple.rounding) return;
  const nsvcd__d3 speed = nsvcd__twist_of(&now.twist, found->point);
  const nsvcd__d3 way = nsvcd__d3_scale(speed, found->tick - since);
  const double margin = 1e4 * now.couple.rounding;
  const int closed[2] = {
      nsvcd__facet_encloses(&p->moving, found->moving_patch, found->moving_listing),
      nsvcd__facet_encloses(&p->fixed, found->fixed_patch, found->fixed_listing)};
  if (nsvcd__d3_length(way) > 0 &&
      nsvcd__met_along(&now.touch, way, is_free, margin, &found->normal))
    return;
  found->normal = nsvcd__shallowest(&now.touch, closed, speed, margin);
}
#endif  // NSVCD_NO_PROOF
