// In: triangle pairs of bodies at rest, as a search finds them. Out: those within the clearance, in
// a list: how near they are, and in which direction.
#pragma once
#include "touches.h"

#ifndef NSVCD_NO_PROOF
// The direction of a triangle pair: out of the fixed one, from its nearest point. If they meet, the
// one of the faces' along which they are the least deep.
static nsvcd__d3 nsvcd__near_direction(const nsvcd__triangle_pair *pair,
                                       const nsvcd__d3 *posed, const nsvcd__nearest *nearest) {
  const nsvcd__d3 apart = nsvcd__d3_sub(nearest->on_a, nearest->on_b);
  if (nearest->square > pair->rounding * pair->rounding)
    return nsvcd__d3_scale(apart, 1 / sqrt(nearest->square));
  const nsvcd__d3 own = nsvcd__d3_scale(nsvcd__face_direction(posed), -1);
  const nsvcd__d3 other = nsvcd__face_direction(pair->fixed);
  const int has_own = nsvcd__d3_dot(own, own) > 0;
  const int is_own = has_own && nsvcd__beyond(own, posed, pair->fixed) >
                                    nsvcd__beyond(other, posed, pair->fixed);
  return is_own || !(nsvcd__d3_dot(other, other) > 0) ? own : other;
}

// The nearest points of a triangle and a corner of another one, which is wholly above it, if they
// are where the corner is over the triangle: no point of the other is lower.
static int nsvcd__lowest_over(const nsvcd__d3 *over, const nsvcd__d3 *under, nsvcd__d3 *corner,
                              nsvcd__d3 *foot) {
  const nsvcd__d3 n = nsvcd__face_normal(under);
  double heights[3];
  for (size_t k = 0; k < 3; k++)
    heights[k] = nsvcd__d3_dot(n, nsvcd__d3_sub(over[k], under[0]));
  const double side = heights[0] < 0 ? -1 : 1;
  size_t lowest = 0;
  for (size_t k = 0; k < 3; k++) {
    if (!(side * heights[k] > 0)) return 0;
    if (side * heights[k] < side * heights[lowest]) lowest = k;
  }
  *corner = over[lowest];
  return nsvcd__foot_within(*corner, under, foot);
}

// As nsvcd__nearest_of, which is not asked where a corner is over a face: mostly.
static nsvcd__nearest nsvcd__near_points(const nsvcd__d3 *moving, const nsvcd__d3 *fixed) {
  nsvcd__nearest out;
  if (!nsvcd__lowest_over(moving, fixed, &out.on_a, &out.on_b) &&
      !nsvcd__lowest_over(fixed, moving, &out.on_b, &out.on_a))
    return nsvcd__nearest_of(moving, fixed);
  out.square = nsvcd__d3_distance2(out.on_a, out.on_b);
  return out;
}

// Is a triangle pair in the list? A triangle that is stored in pieces comes once for each.
static int nsvcd__is_listed(const nsvcd__proof *p, size_t i, size_t j, size_t a, size_t b) {
  const nsvcd__near_list *list = &p->near_list;
  const uint32_t moving = nsvcd__triangle_number(&p->moving, i, a);
  const uint32_t fixed = nsvcd__triangle_number(&p->fixed, j, b);
  for (uint32_t n = list->count; n-- > 0;) {
    const nsvcd__near_pair *item = &list->items[n];
    if (item->moving_triangle == moving && item->fixed_triangle == fixed) return 1;
  }
  return 0;
}

// There is no room for more: keeps those that are nearer than most, and asks for no others.
static NSVCD__NOINLINE void nsvcd__list_nearer_half(nsvcd__proof *p) {
  nsvcd__near_list *list = &p->near_list;
  double sum = 0;
  uint32_t kept = 0;
  for (uint32_t n = 0; n < list->count; n++) sum += (double)list->items[n].distance;
  const double mean = sum / (double)list->count;
  for (uint32_t n = 0; n < list->count; n++)
    if ((double)list->items[n].distance < mean) list->items[kept++] = list->items[n];
  list->is_full = 1;
  if (kept == 0) return;
  list->count = kept;
  p->goal.clearance = mean;
}

// Adds a triangle pair to the list if it comes within the clearance.
static NSVCD__NOINLINE void nsvcd__list_near(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                             const nsvcd__d3 *posed) {
  nsvcd__near_list *list = &p->near_list;
  nsvcd__near_pair item;
  const nsvcd__nearest nearest = nsvcd__near_points(posed, pair->fixed);
  if (!(nearest.square <= p->goal.clearance * p->goal.clearance)) {
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    p->separating = nsvcd__d3_scale(apart, 1 / sqrt(nearest.square));
    return;
  }
  if (list->count == list->room) nsvcd__list_nearer_half(p);
  if (list->count == list->room) return;
  item.distance = (float)sqrt(nearest.square);
  p->separating = nsvcd__near_direction(pair, posed, &nearest);
  item.normal = nsvcd__f3_round(p->separating);
  item.moving_triangle =
      nsvcd__triangle_number(&p->moving, pair->moving_patch, pair->moving_entry);
  item.fixed_triangle =
      nsvcd__triangle_number(&p->fixed, pair->fixed_patch, pair->fixed_entry);
  item.moving_entry = (uint32_t)pair->moving_entry;
  item.fixed_entry = (uint32_t)pair->fixed_entry;
  item.moving_patch = (uint16_t)pair->moving_patch;
  item.fixed_patch = (uint16_t)pair->fixed_patch;
  item.is_resolved = 0;
  list->items[list->count++] = item;
}
#endif  // NSVCD_NO_PROOF
