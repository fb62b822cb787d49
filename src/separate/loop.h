// In: a question, and a motion that has been cut into segments. Out: all of it resolved, or a
// contact that answers the question, or the budget exhausted.
#pragma once
#include "containment.h"
#include "in_order.h"

#ifndef NSVCD_NO_PROOF
// THE LOOP: point 2 of the theorem. Spheres and slabs separate groups of a tile of the moving body
// and one of the fixed body, and then patches of the groups left. What is left of these are patch
// pairs, for nsvcd__sift_patch_pairs and nsvcd__resolve_patch_pairs. In the end each pair of
// patches, in each segment that is wanted and still matters, has been separated, or has given a
// contact that answers or shrinks the question, or is an unresolved pair, or was resolved by its
// parts; or EXHAUSTED says that it has not.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__prove_segments(nsvcd__solver *w,
                                                            nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  nsvcd__outcome outcome;
  for (; q->step < q->steps; q->step++) {
    const size_t next = q->order[q->step];
    const size_t g = q->moving_tile.groups[next];
    nsvcd__search_group(q);
    nsvcd__separate_groups(p, q);
    for (; q->waiting; q->waiting &= q->waiting - 1) {
      const size_t at = nsvcd__low_bit(q->waiting);
      const size_t h = q->fixed_tile.groups[at];
      const uint64_t wanted = nsvcd__nearby(q, next)[at] & nsvcd__segments_that_matter(p, q);
      uint32_t met = nsvcd__group_against_members(q, h, wanted, w->met_in);
      for (; met; met &= met - 1) {
        const size_t l = nsvcd__low_bit(met);
        uint64_t *left = &w->met_in[l];
        if (p->fixed.hull_counts[NSVCD__GROUP * h + l] == 0) continue;
        for (;;) {
          nsvcd__pose_members(q, g, *left);
          nsvcd__add_patch_pairs(w, q, g, NSVCD__GROUP * h + l, left);
          if (!*left) break;
          outcome = nsvcd__take_patch_pairs(w, q);
          if (outcome != NSVCD__DONE) return outcome;
        }
      }
      if (w->fresh_count < NSVCD__ENOUGH_FRESH) continue;
      outcome = nsvcd__take_patch_pairs(w, q);
      if (outcome != NSVCD__DONE) return outcome;
    }
  }
  outcome = nsvcd__take_patch_pairs(w, q);
  if (outcome != NSVCD__DONE || p->goal.collects) return outcome;
  return nsvcd__resolve_patch_pairs(w, q);
}

// The same for all tiles of a motion that has been cut. If the first contact is sought, some
// segments of a tile at a time, until there is a contact: it is the first of the tile. What is
// resolved in one tile says nothing of the others.
static nsvcd__outcome nsvcd__prove_tiles(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  const nsvcd_body *moving = p->moving.body;
  const nsvcd_body *fixed = p->fixed.body;
  const size_t all = q->segments;
  const size_t few = p->goal.first > 0 ? NSVCD__IN_ORDER : all;
  nsvcd__outcome outcome = NSVCD__DONE;
  if (nsvcd__body_groups(moving) == 1 && all <= NSVCD__FEW_SEGMENTS && !p->goal.collects)
    return nsvcd__prove_all_in_order(w, q);
  (void)nsvcd__search_begin(moving, fixed, nsvcd__segments_in(0, all), q);
  do {
    for (size_t s = 0; s < all && outcome == NSVCD__DONE; s += few) {
      const size_t next = s + few < all ? s + few : all;
      if (!nsvcd__matters(p, q, s)) break;
      q->wanted = nsvcd__segments_in(s, next);
      q->step = 0;
      q->waiting = 0;
      outcome = nsvcd__prove_segments(w, q);
      const int one_tile = !nsvcd__is_tiled(moving, fixed);
      if (outcome == NSVCD__DONE && !p->known.has_contact && one_tile)
        p->known.proven_until = (double)q->begin[next];
    }
  } while (outcome == NSVCD__DONE && nsvcd__search_next_tile(q));
  if (outcome == NSVCD__DONE && !p->known.has_contact)
    p->known.proven_until = (double)q->begin[all];
  return outcome;
}

// THE WAIST: until when do the bodies stay apart in the segments that have been chosen, and what do
// they meet? Cuts the segments, and separates the bodies in them.
static NSVCD__NOINLINE nsvcd__search_result nsvcd__separate(nsvcd__solver *w, nsvcd__search *q,
                                                            const nsvcd__goal *goal) {
  nsvcd__proof *p = &w->p;
  p->arcs.motion = goal->motion;
  p->goal = *goal;
  p->goal.first = goal->fraction * (double)goal->motion->ticks;
  p->known.end = nsvcd__min(p->known.end, goal->end);
  nsvcd__cut_segments(goal->motion, p->given.lengths, nsvcd__clearance(goal), q);
  p->known.outcome = nsvcd__prove_tiles(w, q);
  p->known.ran_out = p->known.outcome == NSVCD__EXHAUSTED;
  p->known.clearance = p->goal.clearance;
  return p->known;
}
#endif  // NSVCD_NO_PROOF
