// In: two triangles and an interval. Out: they are separated, or in contact, or too near to tell.
#pragma once
#include "../ground/triangles.h"
#include "motion_bounds.h"

#ifndef NSVCD_NO_PROOF
// The unit normal of a triangle; 0 if the triangle has no area. Rounding, or fused arithmetic,
// makes such a triangle's normal some 1e-16 of its longest edge squared.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__face_direction(const nsvcd__d3 *t) {
  const nsvcd__d3 n = nsvcd__face_normal(t);
  double longest = 0;
  for (size_t k = 0; k < 3; k++)
    longest = nsvcd__max(longest, nsvcd__d3_distance2(t[k], t[(k + 1) % 3]));
  const double length = nsvcd__d3_norm(n);
  return nsvcd__d3_scale(n, length > 1e-9 * longest ? 1 / length : 0);
}

// Two triangles, one of each body, in their frames: the caller's own, of which entries may be
// pieces. A plane that separates a triangle separates its pieces; what meets a triangle meets the
// mesh.
typedef struct nsvcd__triangle_pair {
  size_t moving_patch, fixed_patch, moving_entry, fixed_entry;
  nsvcd__d3 moving[3], fixed[3];
  // The greatest distance of the moving one's points from their body's origin and, at any time of
  // the arc, from the axis of the turn; in its body's units.
  double from_origin, from_axis;
  // of the moving one, at most: the path of a point over the arc
  double speed;
  // how far the meshes' own triangles may be off, and rounding in double; and that rounding alone
  double margin;
  double rounding;
  // too near to halve the interval for
  double close;
} nsvcd__triangle_pair;

// Sets from_origin and from_axis.
static void nsvcd__pair_arm(const nsvcd__arc *arc, nsvcd__triangle_pair *pair) {
  pair->from_origin = pair->from_axis = 0;
  if (nsvcd__is_straight(arc)) return;  // what turns nothing has no arm
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 corner = pair->moving[k];
    const nsvcd__d3 across = nsvcd__d3_cross(corner, arc->own_axis);
    pair->from_origin = nsvcd__max(pair->from_origin, nsvcd__d3_norm(corner));
    pair->from_axis = nsvcd__max(pair->from_axis, nsvcd__d3_norm(across));
  }
  pair->from_axis += (arc->waver + 1e-6) * pair->from_origin;
  pair->from_axis = nsvcd__min(pair->from_axis, pair->from_origin);
}

// Of bodies at rest.
static nsvcd__triangle_pair nsvcd__still_pair_of(const nsvcd__proof *p, size_t i, size_t j,
                                                 size_t a, size_t b) {
  nsvcd__triangle_pair pair = {i, j, a, b, {{0, 0, 0}}, {{0, 0, 0}}, 0, 0, 0, 0, 0, 0};
  nsvcd__patch_triangle(&p->moving, i, a, pair.moving);
  nsvcd__patch_triangle(&p->fixed, j, b, pair.fixed);
  pair.rounding =
      NSVCD__SAME_POSITION * ((double)p->given.lengths + nsvcd__d3_norm(p->arcs.arc.from));
  return pair;
}

static nsvcd__triangle_pair nsvcd__pair_of(const nsvcd__proof *p, size_t i, size_t j, size_t a,
                                           size_t b) {
  nsvcd__triangle_pair pair = nsvcd__still_pair_of(p, i, j, a, b);
  nsvcd__pair_arm(&p->arcs.arc, &pair);
  pair.speed = p->arcs.arc.speed + p->arcs.arc.turn * p->arcs.arc.scale * pair.from_axis;
  const double moved = NSVCD__SAME_POSITION * nsvcd__d3_norm(p->arcs.arc.moved);
  pair.margin = pair.rounding + nsvcd__off_meshes(p) + moved;
  pair.close = pair.margin + NSVCD__TOO_NEAR * (double)p->given.lengths + p->given.tolerance;
  return pair;
}

// The nearest points of a triangle pair at fraction u of the arc.
static nsvcd__nearest nsvcd__pair_nearest(nsvcd__arcs *arcs, const nsvcd__triangle_pair *pair,
                                          double u) {
  nsvcd__d3 moving[3];
  nsvcd__pose_triangle(nsvcd__arc_pose(arcs, u), pair->moving, moving);
  return nsvcd__nearest_of(moving, pair->fixed);
}

// The contact of two triangles at fraction u of the arc.
static nsvcd__pair_contact nsvcd__contact_at(const nsvcd__proof *p,
                                             const nsvcd__triangle_pair *pair, double u,
                                             const nsvcd__nearest *nearest) {
  const nsvcd__d3 face = nsvcd__face_direction(pair->fixed);
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest->on_a, nearest->on_b);
  const double distance = sqrt(nearest->square);
  const int touches = distance <= pair->rounding;
  nsvcd__pair_contact out;
  out.tick = (double)p->arcs.arc.first + u * (double)p->arcs.arc.ticks;
  out.distance = touches ? 0 : distance;
  out.point = nearest->on_b;
  out.normal = touches ? face : nsvcd__d3_unit(apart, nsvcd__d3_of(0, 0, 0));
  out.moving_triangle =
      nsvcd__triangle_number(&p->moving, pair->moving_patch, pair->moving_entry);
  out.fixed_triangle = nsvcd__triangle_number(&p->fixed, pair->fixed_patch, pair->fixed_entry);
  out.moving_entry = (uint32_t)pair->moving_entry;
  out.fixed_entry = (uint32_t)pair->fixed_entry;
  out.moving_patch = (uint16_t)pair->moving_patch;
  out.fixed_patch = (uint16_t)pair->fixed_patch;
  return out;
}

// Two triangles come within the clearance at fraction u of the arc. ANSWERED: that is an answer;
// SHRUNK: there may be a better one.
static nsvcd__outcome nsvcd__take_contact(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                          double u, const nsvcd__nearest *nearest) {
  p->known.has_contact = 1;
  p->known.found = nsvcd__contact_at(p, pair, u, nearest);
  if (p->goal.measure > 0) {
    p->goal.high = p->known.found.distance;
    p->goal.clearance = nsvcd__max(p->goal.low, p->goal.high - p->goal.measure);
    return p->goal.clearance > p->goal.low ? NSVCD__SHRUNK : NSVCD__ANSWERED;
  }
  if (p->goal.first > 0) {
    p->known.end = p->known.found.tick - p->goal.first;
    return p->known.end > 0 ? NSVCD__SHRUNK : NSVCD__ANSWERED;
  }
  return NSVCD__ANSWERED;
}

// Two triangles come too near to each other, from u0 to u1 of the arc, to tell whether they touch.
static NSVCD__NOINLINE void nsvcd__keep_unresolved(nsvcd__proof *p,
                                                   const nsvcd__triangle_pair *pair, double u0,
                                                   double u1) {
  const double tick = (double)p->arcs.arc.first + u0 * (double)p->arcs.arc.ticks;
  const double middle = 0.5 * (u0 + u1);
  const size_t left = p->goal.after_unresolved;
  // a brief first attempt has no budget to save
  const int is_first = !(p->known.unresolved < NSVCD__NEVER) && !p->goal.is_brief;
  if (is_first && p->work + left < p->goal.limit) p->goal.limit = p->work + left;
  if (!(tick < p->known.unresolved)) return;
  const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
  p->known.unresolved_pair = nsvcd__contact_at(p, pair, middle, &nearest);
  p->known.unresolved = tick;
  if (p->goal.unresolved_ends) p->known.end = nsvcd__min(p->known.end, tick);
}

// The fraction of the arc from which on nothing matters.
static double nsvcd__arc_limit(const nsvcd__proof *p) {
  return (p->known.end - (double)p->arcs.arc.first) / (double)p->arcs.arc.ticks;
}

// The deviation of a triangle pair's moving triangle along a unit direction n over the whole arc.
// Over a fraction of the arc it is the square of that fraction times as large. A point at r metres
// from the origin and rho from the axis a of the turn deviates by bend rho |n x a| + twist r +
// origin_bend. Where both bodies turn, a wavers, and so do both distances from it.
static double nsvcd__off_chord_along(const nsvcd__arc *arc, const nsvcd__triangle_pair *pair,
                                     nsvcd__d3 n) {
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(n, arc->axis));
  const double off_axis = nsvcd__min(1, across + arc->waver + 1e-6);
  const double turn = arc->bend * pair->from_axis * off_axis;
  return turn + arc->twist * pair->from_origin + arc->origin_bend;
}

// Does the plane that separated a triangle pair last separate this one from u0 to u1 of the arc?
static int nsvcd__plane_separates(nsvcd__proof *p, const nsvcd__triangle_pair *pair, double u0,
                                  double u1) {
  const nsvcd__d3 normal = p->separating;
  const nsvcd__dtransform *start = nsvcd__arc_pose(&p->arcs, u0);
  const nsvcd__dtransform *end = nsvcd__arc_pose(&p->arcs, u1);
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 at_start = nsvcd__d3_transform(start, pair->moving[k]);
    const nsvcd__d3 at_end = nsvcd__d3_transform(end, pair->moving[k]);
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_start));
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_end));
    highest = nsvcd__max(highest, nsvcd__d3_dot(normal, pair->fixed[k]));
  }
  const double off = nsvcd__off_chord_along(&p->arcs.arc, pair, normal);
  const double deviation = (u1 - u0) * (u1 - u0) * off;
  return lowest - highest > p->goal.clearance + pair->margin + deviation;
}

// Have two heights different signs, clear of 0 by their margins?
static int nsvcd__are_opposite(double before, double least_before, double after,
                               double least_after) {
  const int falls = before > least_before && after < -least_after;
  const int rises = before < -least_before && after > least_after;
  return falls || rises;
}

// In the next three, triangles are given at three times: the start, the middle and the end of an
// interval. Between two of them no point travels farther than `travel`, relative to the other
// triangle.

// Does corner k of triangle x pass through triangle t: does it change sides, and is its foot, in
// the middle, well within t?
static int nsvcd__corner_passes(const nsvcd__d3 *const *x, size_t k, const nsvcd__d3 *const *t,
                                double travel, double margin) {
  const nsvcd__d3 n = nsvcd__face_normal(t[1]);
  const double room = 2 * travel * nsvcd__d3_norm(n);
  for (size_t e = 0; e < 3; e++) {
    const nsvcd__d3 edge = nsvcd__d3_sub(t[1][(e + 1) % 3], t[1][e]);
    const nsvcd__d3 from = nsvcd__d3_sub(x[1][k], t[1][e]);
    const double within = nsvcd__d3_dot(n, nsvcd__d3_cross(edge, from));
    if (!(within > room * nsvcd__d3_norm(edge))) return 0;
  }
  const nsvcd__d3 n0 = nsvcd__face_normal(t[0]);
  const nsvcd__d3 n2 = nsvcd__face_normal(t[2]);
  const double before = nsvcd__d3_dot(n0, nsvcd__d3_sub(x[0][k], t[0][0]));
  const double after = nsvcd__d3_dot(n2, nsvcd__d3_sub(x[2][k], t[2][0]));
  return nsvcd__are_opposite(before, margin * nsvcd__d3_norm(n0), after,
                             margin * nsvcd__d3_norm(n2));
}

// Does edge k of the moving triangle pass through edge n of the fixed one: do they change sides,
// and are their lines, in the middle, nearest to each other well within both? The side is the sign
// of the volume of the tetrahedron of both.
static int nsvcd__edges_pass(const nsvcd__d3 *const *moving, size_t k, const nsvcd__d3 *fixed,
                             size_t n, double travel, double margin) {
  const size_t next = (k + 1) % 3;
  const nsvcd__d3 v = nsvcd__d3_sub(fixed[(n + 1) % 3], fixed[n]);
  nsvcd__d3 across[3], from[3];
  double volumes[3];
  for (size_t at = 0; at < 3; at++) {
    const nsvcd__d3 *a = moving[at];
    across[at] = nsvcd__d3_cross(nsvcd__d3_sub(a[next], a[k]), v);
    from[at] = nsvcd__d3_sub(fixed[n], a[k]);
    volumes[at] = nsvcd__d3_dot(across[at], from[at]);
  }
  const nsvcd__d3 u = nsvcd__d3_sub(moving[1][next], moving[1][k]);
  const double size = nsvcd__d3_norm(across[1]);
  const double lengths = nsvcd__d3_norm(u) * nsvcd__d3_norm(v);
  if (!(size > 0.01 * lengths)) return 0;
  if (!nsvcd__are_opposite(volumes[0], margin * size, volumes[2], margin * size)) return 0;
  const double square = size * size;
  const double s = nsvcd__d3_dot(nsvcd__d3_cross(from[1], v), across[1]) / square;
  const double t = nsvcd__d3_dot(nsvcd__d3_cross(from[1], u), across[1]) / square;
  // the lines' nearest points travel no farther along them
  const double room = 4 * travel * lengths / size;
  const double room_s = room / nsvcd__d3_norm(u);
  const double room_t = room / nsvcd__d3_norm(v);
  return s > room_s && s < 1 - room_s && t > room_t && t < 1 - room_t;
}

// Has a triangle pair met between u0 and u1 of the arc: has a corner passed through the other
// triangle, or an edge through an edge? Faces that are parallel when they meet do so at
// one time only, and rounded numbers show it at none.
static int nsvcd__pair_passes(nsvcd__arcs *arcs, const nsvcd__triangle_pair *pair, double u0,
                              double u1) {
  const double margin = pair->rounding;
  const double travel = pair->speed * (u1 - u0);
  const double times[3] = {u0, 0.5 * (u0 + u1), u1};
  nsvcd__d3 corners[3][3];
  for (size_t n = 0; n < 3; n++)
    nsvcd__pose_triangle(nsvcd__arc_pose(arcs, times[n]), pair->moving, corners[n]);
  const nsvcd__d3 *moving[3] = {corners[0], corners[1], corners[2]};
  const nsvcd__d3 *fixed[3] = {pair->fixed, pair->fixed, pair->fixed};
  for (size_t k = 0; k < 3; k++) {
    if (nsvcd__corner_passes(moving, k, fixed, travel, margin)) return 1;
    if (nsvcd__corner_passes(fixed, k, moving, travel, margin)) return 1;
    for (size_t n = 0; n < 3; n++)
      if (nsvcd__edges_pass(moving, k, pair->fixed, n, travel, margin)) return 1;
  }
  return 0;
}

// How far a triangle is beyond another along a direction. Heights are over a corner of the one, to
// lose as few digits as possible.
static double nsvcd__beyond(nsvcd__d3 n, const nsvcd__d3 *over, const nsvcd__d3 *under) {
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  for (size_t k = 0; k < 3; k++) {
    lowest = nsvcd__min(lowest, nsvcd__d3_dot(n, nsvcd__d3_sub(over[k], under[0])));
    highest = nsvcd__max(highest, nsvcd__d3_dot(n, nsvcd__d3_sub(under[k], under[0])));
  }
  return lowest - highest;
}

// The direction across an edge of each of two triangles, unit: the k-th of 9. 0 if they are
// parallel.
static nsvcd__d3 nsvcd__across_edges(const nsvcd__d3 *a, const nsvcd__d3 *b, size_t k) {
  const nsvcd__d3 u = nsvcd__d3_sub(a[(k + 1) % 3], a[k % 3]);
  const nsvcd__d3 v = nsvcd__d3_sub(b[(k / 3 + 1) % 3], b[k / 3]);
  return nsvcd__d3_unit(nsvcd__d3_cross(u, v), nsvcd__d3_of(0, 0, 0));
}

// A direction made normal to the edge from a to b, unit; 0 if it is along that.
static nsvcd__d3 nsvcd__off_edge(nsvcd__d3 n, nsvcd__d3 a, nsvcd__d3 b) {
  const nsvcd__d3 none = nsvcd__d3_of(0, 0, 0);
  const nsvcd__d3 edge = nsvcd__d3_unit(nsvcd__d3_sub(b, a), none);
  const nsvcd__d3 along = nsvcd__d3_scale(edge, nsvcd__d3_dot(n, edge));
  return nsvcd__d3_unit(nsvcd__d3_sub(n, along), none);
}

// The direction that separates a triangle pair at a time: that of its nearest points. Rounding
// turns it by their roundings over their distance, or by the root of that if several points are as
// near to the last digit. If it keeps less than half of what is above the clearance, others may
// keep more: the normals of the triangles, itself made normal to an edge, and those across an edge
// of each. Returns how far the chosen one separates them.
static NSVCD__NOINLINE double nsvcd__aim_plane(nsvcd__proof *p,
                                               const nsvcd__triangle_pair *pair, double u,
                                               const nsvcd__nearest *nearest) {
  const double distance = sqrt(nearest->square);
  nsvcd__d3 *plane = &p->separating;
  *plane = nsvcd__d3_scale(nsvcd__d3_sub(nearest->on_a, nearest->on_b), 1 / distance);
  const nsvcd__d3 *fixed = pair->fixed;
  const nsvcd__d3 guess = *plane;
  nsvcd__d3 moving[3];
  nsvcd__pose_triangle(nsvcd__arc_pose(&p->arcs, u), pair->moving, moving);
  double best = nsvcd__beyond(guess, moving, fixed);
  const double limit = p->goal.clearance + pair->margin;
  if (best - limit > 0.5 * (distance - limit)) return best;
  for (size_t k = 0; k < 17; k++) {
    const nsvcd__d3 *of = k % 2 ? fixed : moving;
    nsvcd__d3 n = k < 2   ? nsvcd__face_direction(of)
                  : k < 8 ? nsvcd__off_edge(guess, of[k / 2 - 1], of[k / 2 % 3])
                          : nsvcd__across_edges(moving, fixed, k - 8);
    if (nsvcd__d3_dot(n, guess) < 0) n = nsvcd__d3_scale(n, -1);
    const double beyond = nsvcd__beyond(n, moving, fixed);
    if (!(beyond > best)) continue;
    *plane = n;
    best = beyond;
  }
  return best;
}

// A triangle pair that is too near to tell from u0 to u1 of the arc, the nearest at `when`, is kept
// as unresolved. DISTANCE needs only a bound of how near the pair comes, so it lowers the clearance
// to that. TOO_LONG: resolve the part again; ANSWERED: the clearance is at its known bound.
static nsvcd__outcome nsvcd__resolve_too_near(nsvcd__proof *p,
                                              const nsvcd__triangle_pair *pair, double u0,
                                              double u1, double when) {
  if (!(p->goal.measure > 0)) {
    nsvcd__keep_unresolved(p, pair, u0, u1);
    return NSVCD__DONE;
  }
  const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, when);
  const double distance = sqrt(nearest.square);
  if (distance < p->goal.high) (void)nsvcd__take_contact(p, pair, when, &nearest);
  const double separated = distance - 2 * pair->close;
  p->goal.clearance = nsvcd__max(p->goal.low, nsvcd__min(p->goal.clearance, separated));
  return p->goal.clearance > p->goal.low ? NSVCD__TOO_LONG : NSVCD__ANSWERED;
}

// Resolves a part of the arc that is too short to halve. If the triangle pair has passed, the time
// is narrowed down to rounding, and is the contact's. If not, it is unresolved.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_short_interval(
    nsvcd__proof *p, const nsvcd__triangle_pair *pair, double u0, double u1) {
  if (!nsvcd__pair_passes(&p->arcs, pair, u0, u1))
    return nsvcd__resolve_too_near(p, pair, u0, u1, 0.5 * (u0 + u1));
  for (size_t n = 0; n < NSVCD__HALVINGS; n++) {
    const double middle = 0.5 * (u0 + u1);
    p->work++;
    if (nsvcd__pair_passes(&p->arcs, pair, u0, middle))
      u1 = middle;
    else if (nsvcd__pair_passes(&p->arcs, pair, middle, u1))
      u0 = middle;
    else
      break;
  }
  const double when = 0.5 * (u0 + u1);
  nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, when);
  nearest.square = 0;
  return nsvcd__take_contact(p, pair, when, &nearest);
}

// Where the least distance is measured and the moving body goes straight, by `moved` over the arc:
// finds when between u0 and u1 a triangle pair is nearest. Its distance is convex, and falls while
// the nearest points approach each other. Steps of `measure` would not get there.
static nsvcd__outcome nsvcd__take_nearest(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                          double u0, double u1, nsvcd__d3 moved) {
  for (size_t n = 0; n < NSVCD__HALVINGS / 2; n++) {
    const double middle = 0.5 * (u0 + u1);
    const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    p->work++;
    if (sqrt(nearest.square) < p->goal.high &&
        nsvcd__take_contact(p, pair, middle, &nearest) == NSVCD__ANSWERED)
      return NSVCD__ANSWERED;
    const double slope = nsvcd__d3_dot(apart, moved) / sqrt(nearest.square);
    // the distance is nowhere below its tangent
    if (!(fabs(slope) * (u1 - u0) > p->goal.measure)) break;
    if (slope < 0)
      u0 = middle;
    else
      u1 = middle;
  }
  return NSVCD__SHRUNK;
}

// Resolves a triangle pair from u0 to u1 of an arc in which the moving body goes straight. Then its
// distance is a convex function of time, and the plane at its nearest points is a tangent: Newton's
// method, from the start on, comes to the first contact and never past it. The plane that separated
// a pair last is tried first.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_straight(nsvcd__proof *p,
                                                              const nsvcd__triangle_pair *pair,
                                                              double u0, double u1) {
  const nsvcd__arc *arc = &p->arcs.arc;
  const nsvcd__d3 from = nsvcd__arc_pose(&p->arcs, 0)->position;
  const nsvcd__d3 moved = nsvcd__d3_sub(nsvcd__arc_pose(&p->arcs, 1)->position, from);
  double at = u0;
  int shrunk = 0;
  size_t steps = 0;
  const double all = nsvcd__min(u1, nsvcd__arc_limit(p));
  if (u0 < all && nsvcd__plane_separates(p, pair, u0, all)) {
    p->work++;
    return NSVCD__DONE;
  }
  for (double u = u0;;) {  // until u it is separated
    const double end = nsvcd__min(u1, nsvcd__arc_limit(p));
    if (!(u < end)) return shrunk ? NSVCD__SHRUNK : NSVCD__DONE;
    at = nsvcd__min(at, end);
    p->work++;
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, at);
    const double distance = sqrt(nearest.square);
    const double above = distance - p->goal.clearance;
    if (above <= pair->rounding) {
      if (nsvcd__take_contact(p, pair, at, &nearest) == NSVCD__ANSWERED)
        return NSVCD__ANSWERED;
      if (p->goal.measure > 0 &&
          nsvcd__take_nearest(p, pair, u, end, moved) == NSVCD__ANSWERED)
        return NSVCD__ANSWERED;
      shrunk = 1;
      at = u;
      continue;
    }
    const double beyond = nsvcd__aim_plane(p, pair, at, &nearest);
    const double fall = -nsvcd__d3_dot(p->separating, moved);
    const double room = beyond - p->goal.clearance - pair->margin - pair->rounding;
    const double until = fall > 0 ? nsvcd__min(end, at + room / fall) : end;
    if (u < until && nsvcd__plane_separates(p, pair, u, until)) u = until;
    const int is_short = !(room > 0) || arc->speed * (at - u) <= 0.25 * pair->close;
    const int is_unresolved = fall > 0 ? !(at < end) : is_short;
    if (u < end && (is_unresolved || steps++ == NSVCD__HALVINGS)) {
      // what follows is no nearer
      const nsvcd__outcome part = nsvcd__resolve_too_near(p, pair, u, at, at);
      if (part == NSVCD__ANSWERED) return part;
      if (part == NSVCD__DONE) u = end;
    } else {
      at = fall > 0 ? at + above / fall : 0.5 * (u + at);
    }
  }
}

// Resolves a triangle pair from u0 to u1 of the arc: halves the time until, in each part, a plane
// separates the triangles, or there is a contact, or they are too near to tell. After each
// unresolved part, longer ones count as too short: the question left is whether they meet. The
// planes tried are the one that separated a pair last, and the one that nsvcd__aim_plane finds.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_pair(nsvcd__proof *p,
                                                          const nsvcd__triangle_pair *pair,
                                                          double u0, double u1) {
  if (nsvcd__is_straight(&p->arcs.arc)) return nsvcd__resolve_straight(p, pair, u0, u1);
  double *ends = p->pair_ends;
  size_t left = 1;
  size_t unresolved_count = 0;
  int shrunk = 0;
  ends[0] = u1;
  for (double u = u0; left > 0;) {
    const double end = nsvcd__min(ends[left - 1], nsvcd__arc_limit(p));
    if (!(u < end)) break;  // an unresolved pair may be the end
    const double middle = 0.5 * (u + end);
    p->work++;
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    int apart = nsvcd__plane_separates(p, pair, u, end);
    if (!apart) {
      const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
      const double distance = sqrt(nearest.square);
      if (distance <= p->goal.clearance + pair->rounding) {
        if (nsvcd__take_contact(p, pair, middle, &nearest) == NSVCD__ANSWERED)
          return NSVCD__ANSWERED;
        shrunk = 1;
        continue;
      }
      (void)nsvcd__aim_plane(p, pair, middle, &nearest);
      apart = nsvcd__plane_separates(p, pair, u, end);
    }
    if (!apart) {
      const double least = 0.25 * pair->close * (double)(1 + unresolved_count);
      const int is_short = pair->speed * (end - u) <= least || left > NSVCD__HALVINGS;
      if (!is_short) {
        ends[left++] = middle;
        p->parts++;
        continue;
      }
      const nsvcd__outcome part = nsvcd__resolve_short_interval(p, pair, u, end);
      if (part == NSVCD__ANSWERED) return part;
      shrunk |= part == NSVCD__SHRUNK;
      if (part != NSVCD__DONE) continue;
      unresolved_count++;
    }
    u = end;
    left--;
  }
  return shrunk ? NSVCD__SHRUNK : NSVCD__DONE;
}
#endif  // NSVCD_NO_PROOF
