// In: a patch pair and a time. Out: a contact: two triangles that meet then, or come within the
// clearance; with a slop, what touches at the start and which directions undo it.
#pragma once
#include "../triangles/near.h"
#include "../triangles/touches.h"
#include "blocks.h"

#ifndef NSVCD_NO_PROOF
// Seeks a contact of the moving block, posed `at`, and block n of the window, at fraction u of the
// arc.
static nsvcd__outcome nsvcd__find_witness_in(nsvcd__solver *w, size_t i, size_t j, size_t n,
                                             const nsvcd__dtransform *at, double u,
                                             float margin) {
  nsvcd__proof *p = &w->p;
  nsvcd__block *fixed = &w->blocks.fixed[n];
  const double clearance = p->goal.clearance;
  const uint32_t nearby = nsvcd__lanes_near(&w->blocks.moving, w->blocks.bounds[n], margin);
  uint32_t lanes = nsvcd__lanes_left_by_last(w, fixed, margin, nearby);
  for (; lanes; lanes &= lanes - 1) {
    const size_t l = nsvcd__low_bit(lanes);
    p->work++;
    uint32_t met = nsvcd__row_left(w, l, fixed, margin);
    for (; met; met &= met - 1) {
      if (clearance > 0)
        met = nsvcd__left_by_normal(w, l, fixed, NSVCD__LAST_NORMAL, margin, met);
      if (!met) break;
      const size_t entry = w->blocks.moving.first + l;
      const size_t other = fixed->first + nsvcd__low_bit(met);
      if (p->goal.collects == NSVCD__LISTING && nsvcd__is_listed(p, i, j, entry, other))
        continue;
      const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, entry, other);
      nsvcd__d3 posed[3];
      nsvcd__nearest nearest = {0, {0, 0, 0}, {0, 0, 0}};
      nsvcd__pose_triangle(at, pair.moving, posed);
      p->work++;
      if (p->goal.collects == NSVCD__LISTING) {
        nsvcd__list_near(p, &pair, posed);
        continue;
      }
      if (nsvcd__triangles_meet(posed, pair.fixed, &nearest.on_b)) {
        nearest.on_a = nearest.on_b;
      } else {
        if (!(clearance > 0)) continue;
        nearest = nsvcd__nearest_of(posed, pair.fixed);
        if (!(nearest.square <= clearance * clearance)) {
          const nsvcd__d3 distance = nsvcd__d3_sub(nearest.on_a, nearest.on_b);
          p->separating = nsvcd__d3_scale(distance, 1 / sqrt(nearest.square));
          continue;
        }
      }
      if (p->goal.collects == NSVCD__TOUCHING) {
        nsvcd__collect_contact(p, &pair, posed);
        continue;
      }
      const nsvcd__outcome contact = nsvcd__take_contact(p, &pair, u, &nearest);
      if (contact == NSVCD__ANSWERED) return contact;
      // They may touch sooner, or come closer.
      const nsvcd__outcome better = nsvcd__resolve_pair(p, &pair, 0, 1);
      return better == NSVCD__ANSWERED ? better : contact;
    }
  }
  return NSVCD__NOTHING;
}

// Loads 16 triangles of moving patch i, from entry `first` on. They are often loaded already.
static void nsvcd__moving_block_load(nsvcd__blocks *b, const nsvcd__geometry *f, size_t i,
                                     size_t first) {
  const size_t left = f->first_triangle[i + 1] - first;
  if (b->has_block && b->moving.first == first) return;
  b->has_block = 1;
  nsvcd__block_load(f, i, first, left < NSVCD__LANES ? left : NSVCD__LANES, &b->moving);
}

// Seeks a contact of triangles of patches i and j at fraction u of an arc.
static nsvcd__outcome nsvcd__find_witness(nsvcd__solver *w, size_t i, size_t j, uint32_t first,
                                          double u) {
  nsvcd__proof *p = &w->p;
  const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, first);
  const nsvcd__dtransform at = nsvcd__dtransform_at(arc, u);
  const nsvcd__transform rounded = nsvcd__transform_of(&at);
  const float lengths = p->given.lengths + nsvcd__f3_norm(rounded.position);
  const float margin =
      NSVCD__ROUNDING * lengths + nsvcd__clearance(&p->goal) + nsvcd__errors_of(p, i, j);
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  for (size_t b = p->fixed.first_triangle[j]; b < fixed_end;
       b += NSVCD__WINDOW * NSVCD__LANES) {
    nsvcd__window_load(&w->blocks, &p->fixed, j, b);
    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {
      nsvcd__moving_block_load(&w->blocks, &p->moving, i, a);
      nsvcd__block_pose(&w->blocks, &rounded, NULL);
      for (size_t n = 0; n < w->blocks.window; n++) {
        p->work++;
        if (nsvcd__check_budget(p)) return NSVCD__NOTHING;
        const nsvcd__outcome found = nsvcd__find_witness_in(w, i, j, n, &at, u, margin);
        if (found != NSVCD__NOTHING) return found;
      }
    }
  }
  return NSVCD__NOTHING;
}

// The keyframe at which the arc of a time in ticks begins, the last one that is not after it; and
// how much of the arc has gone by.
static uint32_t nsvcd__arc_of(const nsvcd__motion *m, double time, double *fraction) {
  const uint32_t last = m->ticks - 1;
  const uint32_t tick = time < (double)last ? (uint32_t)time : last;
  const uint32_t a = nsvcd__tick_of(&m->moving, nsvcd__pose_before(&m->moving, tick));
  const uint32_t b = nsvcd__tick_of(&m->fixed, nsvcd__pose_before(&m->fixed, tick));
  const uint32_t first = a > b ? a : b;
  *fraction = (time - (double)first) / (double)(nsvcd__next_keyframe(m, first) - first);
  return first;
}

// Seeks a contact of a patch pair when its spheres are nearest, if that still matters.
static nsvcd__outcome nsvcd__seek_in_patch_pair(nsvcd__solver *w, const nsvcd__search *q,
                                                nsvcd__patch_pair *pair) {
  nsvcd__proof *p = &w->p;
  const double start = (double)q->begin[pair->segment];
  const double end = nsvcd__min((double)q->begin[pair->segment + 1u], w->clipped_end);
  const double tick = start + (double)pair->fraction * (end - start);
  double u;
  pair->sought = 1;
  if (!(tick < p->known.end)) return NSVCD__NOTHING;
  const uint32_t first = nsvcd__arc_of(p->arcs.motion, tick, &u);
  return nsvcd__find_witness(w, pair->moving, pair->fixed, first, u);
}
#endif  // NSVCD_NO_PROOF
