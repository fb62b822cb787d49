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

// Adds a triangle pair to the list if it comes within the clearance. A triangle that is stored in
// pieces comes once for each.
static NSVCD__NOINLINE void nsvcd__list_near(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                             const nsvcd__d3 *posed) {
  nsvcd__near_list *list = &p->near_list;
  nsvcd__near item;
  item.moving_triangle =
      nsvcd__triangle_number(&p->moving, pair->moving_patch, pair->moving_entry);
  item.fixed_triangle =
      nsvcd__triangle_number(&p->fixed, pair->fixed_patch, pair->fixed_entry);
  for (uint32_t n = list->count; n-- > 0;) {
    if (list->items[n].moving_triangle == item.moving_triangle &&
        list->items[n].fixed_triangle == item.fixed_triangle)
      return;
  }
  const nsvcd__nearest nearest = nsvcd__nearest_of(posed, pair->fixed);
  if (!(nearest.square <= p->goal.clearance * p->goal.clearance)) {
    const nsvcd__d3 apart = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
    p->separating = nsvcd__d3_scale(apart, 1 / sqrt(nearest.square));
    return;
  }
  list->is_full |= list->count == list->room;
  if (list->is_full) return;
  item.distance = (float)sqrt(nearest.square);
  item.normal = nsvcd__f3_round(nsvcd__near_direction(pair, posed, &nearest));
  item.moving_entry = (uint32_t)pair->moving_entry;
  item.fixed_entry = (uint32_t)pair->fixed_entry;
  item.moving_patch = (uint16_t)pair->moving_patch;
  item.fixed_patch = (uint16_t)pair->fixed_patch;
  item.is_settled = 0;
  list->items[list->count++] = item;
}
#endif  // NSVCD_NO_PROOF
