// In: triangle pairs that are near each other when a contact is. Out: up to four contact points
// that hold the body: those that span the largest area, seen along the contact's normal.
//
// Two triangles touch where a corner of one is over the other, or where two edges cross. Of all
// such points the farthest along eight directions are kept, for a slim contact those across it too,
// and of these the best four. Of two points equally far, the one with the lower number is kept: so
// the same points are chosen again when little has moved. Only normals close to the contact's
// count: where a side rises from the floor, corners of the floor's triangles are near the side as
// well, but the body does not stand on it.
#pragma once
#include "normals.h"

#ifndef NSVCD_NO_PROOF
// A surface that leans towards the other by more than this sine goes on to where it is nearer.
#define NSVCD__STEEP 0.1

// A near triangle pair as it is posed.
typedef struct nsvcd__posed_pair {
  nsvcd__triangle_pair pair;
  nsvcd__d3 posed[3];  // the moving triangle
} nsvcd__posed_pair;

static void nsvcd__posed_pair_of(const nsvcd__proof *p, const nsvcd__dtransform *at,
                                 const nsvcd__near_pair *item, nsvcd__posed_pair *out) {
  out->pair = nsvcd__still_pair_of(p, item->moving_patch, item->fixed_patch,
                                   item->moving_entry, item->fixed_entry);
  nsvcd__pose_triangle(at, out->pair.moving, out->posed);
}

// Does a triangle go on along a direction from a point of it, or near it?
static int nsvcd__goes_on(const nsvcd__d3 *triangle, nsvcd__d3 from, nsvcd__d3 along,
                          double same) {
  const nsvcd__d3 point[3] = {from, from, from};
  int goes_on = 0;
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 arm = nsvcd__d3_sub(triangle[k], from);
    const double height = nsvcd__d3_dot(along, arm);
    goes_on |= height > same && height > NSVCD__STEEP * nsvcd__d3_norm(arm);
  }
  return goes_on && nsvcd__nearest_of(triangle, point).square <= same * same;
}

// Does a surface go on from where two triangles are near each other, with this direction, to where
// the other is nearer? Then that is no contact. It is enough to ask the triangles of one body at a
// time, each with the same triangle of the other, and these are in the list as well.
static NSVCD__NOINLINE int nsvcd__goes_on_beside(const nsvcd__proof *p, uint32_t moving,
                                                 uint32_t fixed, const nsvcd__nearest *points,
                                                 nsvcd__d3 normal) {
  const nsvcd__near_list *list = &p->near_list;
  const nsvcd__dtransform at = nsvcd__dtransform_at(&p->arcs.arc, 0);
  const nsvcd__d3 back = nsvcd__d3_scale(normal, -1);
  const double same = nsvcd__epsilon(p);
  for (uint32_t n = 0; n < list->count; n++) {
    const nsvcd__near_pair *item = &list->items[n];
    const int same_moving = item->moving_triangle == moving;
    const int same_fixed = item->fixed_triangle == fixed;
    if (!same_moving && !same_fixed) continue;
    nsvcd__posed_pair at_it;
    nsvcd__posed_pair_of(p, &at, item, &at_it);
    if (same_moving && nsvcd__goes_on(at_it.pair.fixed, points->on_b, normal, same)) return 1;
    if (same_fixed && nsvcd__goes_on(at_it.posed, points->on_a, back, same)) return 1;
  }
  return 0;
}

// A triangle pair of a manifold.
typedef struct nsvcd__facing {
  const nsvcd__triangle_pair *pair;
  const nsvcd__d3 *posed;  // the moving triangle
  // normals out of the fixed body; of an open surface on the side of the contact's
  nsvcd__d3 faces[2];
  int is_open;  // one is of an open surface
} nsvcd__facing;

static nsvcd__facing nsvcd__facing_of(const nsvcd__proof *p, nsvcd__d3 n,
                                      const nsvcd__triangle_pair *pair,
                                      const nsvcd__d3 *posed) {
  const int closed[2] = {nsvcd__moving_closed(p, pair), nsvcd__fixed_closed(p, pair)};
  nsvcd__facing out = {pair, posed, {{0, 0, 0}, {0, 0, 0}}, !closed[0] || !closed[1]};
  out.faces[0] = nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
  out.faces[1] = nsvcd__face_direction(pair->fixed);
  for (int k = 0; k < 2; k++) {
    nsvcd__d3 *face = &out.faces[k];
    const int turned = nsvcd__d3_dot(*face, n) < 0;
    if (turned && !closed[k]) *face = nsvcd__d3_scale(*face, -1);
  }
  return out;
}

// Does point x come apart along its normal, while one of its faces comes nearer? Then it is no
// contact, or one of another triangle pair.
static int nsvcd__is_left(const nsvcd__twist *twist, nsvcd__d3 x, nsvcd__d3 normal,
                          const nsvcd__d3 *faces) {
  const nsvcd__d3 speed = nsvcd__twist_of(twist, x);
  const double least = 1e-7 * nsvcd__d3_norm(speed);
  if (!(nsvcd__d3_dot(speed, normal) > least)) return 0;
  for (int k = 0; k < 2; k++)
    if (nsvcd__d3_dot(speed, faces[k]) < -least) return 1;
  return 0;
}

// Keeps a point where a triangle pair touches, if it is farther out than those kept. normal: of a
// face, or across two edges, of either sign.
static NSVCD__NOINLINE void nsvcd__keep_support(const nsvcd__proof *p, nsvcd__manifold *m,
                                                const nsvcd__facing *f, nsvcd__d3 on_moving,
                                                nsvcd__d3 on_fixed, nsvcd__d3 normal,
                                                uint32_t number) {
  const double side = nsvcd__d3_dot(normal, m->normal) < 0 ? -1 : 1;
  const nsvcd__d3 offset = nsvcd__d3_sub(on_moving, on_fixed);
  const double gap = side * nsvcd__d3_dot(offset, normal);
  const double aside = nsvcd__d3_dot(offset, offset) - gap * gap;
  nsvcd__d3 point;
  // Past the end of an edge they are not over each other.
  if (aside > 0.01 * m->same * m->same) return;
  // Nor are they on the far side of a sheet that they do not pass through.
  if (gap < 0 && f->is_open && !nsvcd__triangles_meet(f->posed, f->pair->fixed, &point))
    return;
  if (nsvcd__is_left(&m->twist, on_fixed, nsvcd__d3_scale(normal, side), f->faces)) return;
  nsvcd__nearest nearest = {gap > 0 ? gap * gap : 0, on_moving, on_fixed};
  nsvcd__pair_contact contact;
  int known = 0;
  for (int k = 0; k < NSVCD__SUPPORTS; k++) {
    const double along_it = nsvcd__d3_dot(m->along[k], on_fixed);
    const double more = along_it - m->farthest[k];
    if (!(more > m->same || (more >= -m->same && number < m->numbers[k]))) continue;
    if (!known) {
      contact = nsvcd__contact_at(p, f->pair, 0, &nearest);
      if ((number & 2) &&
          nsvcd__goes_on_beside(p, contact.moving_triangle, contact.fixed_triangle, &nearest,
                                nsvcd__d3_scale(normal, side)))
        return;
    }
    known = 1;
    contact.normal = nsvcd__d3_scale(normal, side);
    m->supports[k] = contact;
    m->numbers[k] = number;
    m->farthest[k] = along_it;
  }
}

// Keeps all points where a triangle pair touches, within the tolerance. posed: the moving triangle.
// Corner k of entry e has the number 4 (3 e + k), and 1 more if it is of the fixed body.
static NSVCD__NOINLINE void nsvcd__collect_supports(const nsvcd__proof *p, nsvcd__manifold *m,
                                                    const nsvcd__triangle_pair *pair,
                                                    const nsvcd__d3 *posed) {
  const nsvcd__d3 *fixed = pair->fixed;
  nsvcd__d3 foot;
  int farther = 0;
  for (int k = 0; k < NSVCD__SUPPORTS && !farther; k++) {
    for (int i = 0; i < 3; i++)
      farther |=
          nsvcd__d3_dot(m->along[k], posed[i]) + m->tolerance >= m->farthest[k] - m->same;
  }
  if (!farther) return;
  // Faces must be about normal to the contact's.
  const nsvcd__facing facing = nsvcd__facing_of(p, m->normal, pair, posed);
  const int moving_faces = nsvcd__d3_dot(facing.faces[0], m->normal) >= 0.8;
  const int fixed_faces = nsvcd__d3_dot(facing.faces[1], m->normal) >= 0.8;
  for (size_t k = 0; k < 3; k++) {
    const uint32_t moving_id = (uint32_t)(3 * pair->moving_entry + k) << 2;
    const uint32_t fixed_id = (uint32_t)(3 * pair->fixed_entry + k) << 2 | 1;
    if (fixed_faces && nsvcd__foot_within(posed[k], fixed, &foot) &&
        nsvcd__d3_distance2(posed[k], foot) <= m->tolerance * m->tolerance)
      nsvcd__keep_support(p, m, &facing, posed[k], foot, facing.faces[1], moving_id);
    if (moving_faces && nsvcd__foot_within(fixed[k], posed, &foot) &&
        nsvcd__d3_distance2(fixed[k], foot) <= m->tolerance * m->tolerance)
      nsvcd__keep_support(p, m, &facing, foot, fixed[k], facing.faces[0], fixed_id);
    for (size_t i = 0; i < 3; i++) {
      const nsvcd__d3 a = posed[(k + 1) % 3];
      const nsvcd__d3 b = fixed[(i + 1) % 3];
      const nsvcd__d3 u = nsvcd__d3_sub(a, posed[k]);
      const nsvcd__d3 v = nsvcd__d3_sub(b, fixed[i]);
      const nsvcd__d3 across = nsvcd__d3_cross(u, v);
      const double along = nsvcd__d3_dot(across, m->normal);
      const double square = nsvcd__d3_dot(across, across);
      const double lengths = nsvcd__d3_dot(u, u) * nsvcd__d3_dot(v, v);
      nsvcd__nearest nearest = {HUGE_VAL, {0, 0, 0}, {0, 0, 0}};
      if (!(square > 1e-4 * lengths)) continue;
      if (along * along < 0.64 * square) continue;
      nsvcd__edges_nearest(posed[k], a, fixed[i], b, &nearest);
      if (!(nearest.square <= m->tolerance * m->tolerance)) continue;
      const uint32_t number = moving_id * 3 + fixed_id * 5 + (uint32_t)(1 + i) * 0x9e3779b9u;
      nsvcd__keep_support(p, m, &facing, nearest.on_a, nearest.on_b,
                          nsvcd__d3_unit(across, facing.faces[1]), number | 2);
    }
  }
}

#endif  // NSVCD_NO_PROOF
