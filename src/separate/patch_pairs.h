// In: fresh patch pairs, as the search finds them. Out: each is separated, by a plane between its
// hulls or by its triangles, or in contact, or kept as an unresolved pair.
#pragma once
#include "../interface/queries.h"
#include "../search/search.h"
#include "witnesses.h"

#ifndef NSVCD_NO_PROOF
// Does the plane that separated a triangle pair last separate all of patches i and j from u0 to u1
// of the arc, in double? Where flat lies on flat, nearer than floats can tell, it mostly does.
static NSVCD__NOINLINE int nsvcd__patches_apart(nsvcd__proof *p, size_t i, size_t j, double u0,
                                                double u1) {
  const size_t moving_first = p->moving.first_triangle[i];
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_first = p->fixed.first_triangle[j];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  size_t top = fixed_first;
  double highest = -HUGE_VAL;
  for (size_t b = fixed_first; b < fixed_end; b++) {
    nsvcd__d3 corners[3];
    nsvcd__patch_triangle(&p->fixed, j, b, corners);
    for (size_t k = 0; k < 3; k++) {
      const double height = nsvcd__d3_dot(p->separating, corners[k]);
      if (height > highest) top = b;
      highest = nsvcd__max(highest, height);
    }
  }
  p->work += (fixed_end - fixed_first) / NSVCD__LANES;
  for (size_t a = moving_first; a < moving_end; a++) {
    const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, a, top);
    if ((a - moving_first) % 4 == 0) p->work++;
    if (!nsvcd__plane_separates(p, &pair, u0, u1)) return 0;
  }
  return 1;
}

// Lane l of the moving block, posed at both ends of an interval from u0 to u1 of the arc, and a
// block of the window: the triangle pairs that no plane separates are resolved one by one. The
// plane that separates one may separate others or, ALL_RESOLVED, all of both patches. TOO_LONG:
// they ask for more than `patience` parts of the interval or, without any, there is such a triangle
// pair.
static nsvcd__outcome nsvcd__resolve_row(nsvcd__solver *w, size_t l, nsvcd__block *fixed,
                                         nsvcd__arm arm, float margin, double u0, double u1,
                                         size_t patience) {
  nsvcd__proof *p = &w->p;
  const nsvcd__interval *over = w->blocks.over;
  const size_t i = w->blocks.moving.patch;
  const size_t j = fixed->patch;
  const float errors = nsvcd__errors_of(p, i, j);
  p->work++;
  uint32_t met = nsvcd__row_left(w, l, fixed, margin);
  for (; met; met &= met - 1) {
    const nsvcd__d3 before = p->separating;
    const nsvcd__f3 last = nsvcd__f3_round(before);
    const float along = errors + over->rounding + nsvcd__clearance(&p->goal) +
                        nsvcd__deviation_of(over, last, arm);
    met = nsvcd__left_by_normal(w, l, fixed, NSVCD__LAST_NORMAL, along, met);
    if (!met) break;
    if (patience == 0) return NSVCD__TOO_LONG;
    if (p->shared > NSVCD__SHARED * w->all_tried) {
      w->all_tried++;
      if (nsvcd__patches_apart(p, i, j, u0, u1)) return NSVCD__ALL_DONE;
    }
    const size_t a = w->blocks.moving.first + l;
    const size_t b = fixed->first + nsvcd__low_bit(met);
    const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, a, b);
    const nsvcd__outcome one = nsvcd__resolve_pair(p, &pair, u0, u1);
    // where the question shrank, the pair is resolved for what is left of it
    if (one != NSVCD__DONE && one != NSVCD__SHRUNK) return one;
    if (p->parts > patience) return NSVCD__TOO_LONG;
    p->shared = nsvcd__d3_distance2(p->separating, before) > 0 ? 0 : p->shared + 1;
  }
  return NSVCD__DONE;
}

// All triangle pairs of patches i and j over an interval from u0 to u1 of the arc.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_triangles(nsvcd__solver *w, size_t i,
                                                               size_t j,
                                                               const nsvcd__interval *over,
                                                               double u0, double u1,
                                                               size_t patience) {
  nsvcd__proof *p = &w->p;
  const size_t moving_end = p->moving.first_triangle[i + 1];
  const size_t fixed_end = p->fixed.first_triangle[j + 1];
  const nsvcd__f3 axis = nsvcd__own_axis(over);
  const float stays = nsvcd__errors_of(p, i, j) + (over->rounding + over->origin_bend) +
                      nsvcd__clearance(&p->goal);
  const float error = p->moving.errors[i];
  const float extent = p->moving.body->extent + error;
  const nsvcd__arm all = {extent, extent};
  // else arms of blocks gain little
  const int bends = over->bend * extent > 0.25f * stays;
  p->parts = 0;
  w->all_tried = 0;
  for (size_t b = p->fixed.first_triangle[j]; b < fixed_end;
       b += NSVCD__WINDOW * NSVCD__LANES) {
    nsvcd__window_load(&w->blocks, &p->fixed, j, b);
    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {
      nsvcd__moving_block_load(&w->blocks, &p->moving, i, a);
      const nsvcd__arm arm = bends ? nsvcd__block_arm(&w->blocks.moving, axis, error) : all;
      const float margin = stays + nsvcd__bend_of(over, arm);
      nsvcd__block_pose(&w->blocks, NULL, over);
      for (size_t n = 0; n < w->blocks.window; n++) {
        nsvcd__block *fixed = &w->blocks.fixed[n];
        const uint32_t nearby =
            nsvcd__lanes_near(&w->blocks.moving, w->blocks.bounds[n], margin);
        uint32_t lanes = nsvcd__lanes_left_by_last(w, fixed, margin, nearby);
        p->work++;
        if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
        for (; lanes; lanes &= lanes - 1) {
          const nsvcd__outcome row = nsvcd__resolve_row(w, nsvcd__low_bit(lanes), fixed, arm,
                                                        margin, u0, u1, patience);
          if (row == NSVCD__ALL_DONE) return NSVCD__DONE;
          if (row != NSVCD__DONE) return row;
        }
      }
    }
  }
  return NSVCD__DONE;
}

// Resolves a patch pair that no plane separates over its segment, arc by arc. An arc is halved
// until each part is resolved by a plane between the hulls, or by the triangles.
static nsvcd__outcome nsvcd__resolve_patch_pair(nsvcd__solver *w, const nsvcd__search *q,
                                                const nsvcd__patch_pair *patches) {
  nsvcd__proof *p = &w->p;
  const nsvcd__motion *m = p->arcs.motion;
  const size_t i = patches->moving;
  const size_t j = patches->fixed;
  const uint32_t last = q->begin[patches->segment + 1u];
  double *ends = w->arc_ends;
  int is_tried = 1;  // is it all of the segment?
  for (uint32_t at = q->begin[patches->segment]; at < last && (double)at < p->known.end;) {
    double u;
    const uint32_t first = nsvcd__arc_of(m, (double)at, &u);
    const uint32_t keyframe = nsvcd__next_keyframe(m, first);
    at = last < keyframe ? last : keyframe;
    is_tried = is_tried && at == last;
    ends[0] = (double)(at - first) / (double)(keyframe - first);
    for (size_t left = 1; left > 0;) {
      nsvcd__arc_at(&p->arcs, first);
      const double end = nsvcd__min(ends[left - 1], nsvcd__arc_limit(p));
      if (!(u < end)) break;
      w->interval = nsvcd__interval_of_arc(p, first, u, end);
      const int apart = !is_tried && nsvcd__hulls_are_apart(w, i, j, &w->interval);
      is_tried = 0;
      if (!apart) {
        const int may_halve = end - u > NSVCD__SHORTEST && left < NSVCD__ARC_PARTS;
        const size_t patience = may_halve ? NSVCD__FEW_PARTS : (size_t)-1;
        const nsvcd__outcome part =
            nsvcd__resolve_triangles(w, i, j, &w->interval, u, end, patience);
        if (part == NSVCD__ANSWERED || part == NSVCD__EXHAUSTED) return part;
        if (part == NSVCD__TOO_LONG) ends[left++] = 0.5 * (u + end);
        if (part != NSVCD__DONE) continue;
      }
      u = end;
      left--;
    }
  }
  return NSVCD__DONE;
}

// Does any plane separate a patch pair over its segment?
static int nsvcd__is_separated(nsvcd__solver *w, const nsvcd__search *q,
                               const nsvcd__patch_pair *patches) {
  const nsvcd__interval *over = nsvcd__segment_interval(w, q, patches->segment);
  return nsvcd__hulls_are_apart(w, patches->moving, patches->fixed, over);
}

// Does a patch pair come before another? Deepest first. For the first contact: earliest closest
// approach within a segment, and earlier segments once a contact is known.
static int nsvcd__is_before(const nsvcd__proof *p, const nsvcd__patch_pair *a,
                            const nsvcd__patch_pair *b) {
  if (!(p->goal.first > 0)) return a->depth > b->depth;
  if (a->segment == b->segment) return a->fraction < b->fraction;
  return p->known.has_contact ? a->segment < b->segment : a->depth > b->depth;
}

static void nsvcd__sort_patch_pairs(const nsvcd__proof *p, nsvcd__patch_pair *pairs,
                                    size_t count) {
  for (size_t n = 1; n < count; n++) {
    const nsvcd__patch_pair patches = pairs[n];
    size_t at = n;
    for (; at > 0 && nsvcd__is_before(p, &patches, &pairs[at - 1]); at--)
      pairs[at] = pairs[at - 1];
    pairs[at] = patches;
  }
}

// Does a segment still matter?
static int nsvcd__matters(const nsvcd__proof *p, const nsvcd__search *q, size_t segment) {
  return (double)q->begin[segment] < p->known.end;
}

// Clips the segment in which the end of what matters lies. What leaves a chord by some length
// leaves that of a part of the time by no more than twice that, along any direction.
static NSVCD__NOINLINE void nsvcd__clip_segment(nsvcd__solver *w, nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  size_t s = 0;
  double u;
  if (!(p->known.end < w->clipped_end)) return;
  w->clipped_end = p->known.end;
  while (s < q->segments && !((double)q->begin[s + 1] > p->known.end)) s++;
  if (s == q->segments || !((double)q->begin[s] < p->known.end)) return;
  nsvcd__segments *block = &q->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  const uint32_t first = nsvcd__arc_of(p->arcs.motion, p->known.end, &u);
  const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, first), u);
  const nsvcd__transform end = nsvcd__transform_of(&at);
  const nsvcd__mat3 start = nsvcd__mat3_lane(block->rotation, l);
  const nsvcd__mat3 turned = nsvcd__mat3_mix(1, &end.rotation, -1, &start);
  const nsvcd__f3 position = nsvcd__lane_of(block->position, l);
  nsvcd__lane_set(nsvcd__f3_sub(end.position, position), block->moved, l);
  nsvcd__lane_set(turned.x, block->turned, l);
  nsvcd__lane_set(turned.y, block->turned + 3, l);
  nsvcd__lane_set(turned.z, block->turned + 6, l);
  if (!(w->clipped >> s & 1)) {
    block->margin[l] += block->origin_bend[l];
    block->bend[l] *= 2;
    block->origin_bend[l] *= 2;
    block->bend_along_axis[l] *= 2;
    block->origin_along_axis[l] *= 2;
    block->origin_off_heading[l] *= 2;
  }
  w->clipped |= (uint64_t)1 << s;
  w->memo.intervals &= ~((uint64_t)1 << s);
  q->ready &= ~((uint64_t)1 << s);
  // the heights over the plane that held last are no longer right
  w->memo.plane += w->memo.plane > 0;
}

// Resolves the patch pairs that no plane separates.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__resolve_patch_pairs(nsvcd__solver *w,
                                                                 nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  nsvcd__sort_patch_pairs(p, p->of.kept.pairs, w->count);
  for (size_t n = 0; n < w->count; n++) {
    const nsvcd__patch_pair *patches = &p->of.kept.pairs[n];
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    nsvcd__clip_segment(w, q);
    if (!nsvcd__matters(p, q, patches->segment)) continue;
    const int is_clipped = (w->clipped >> patches->segment & 1) != 0;
    if (is_clipped && nsvcd__is_separated(w, q, patches)) continue;
    const nsvcd__outcome outcome = nsvcd__resolve_patch_pair(w, q, patches);
    if (outcome != NSVCD__DONE) return outcome;
  }
  w->count = 0;
  return nsvcd__check_budget(p) ? NSVCD__EXHAUSTED : NSVCD__DONE;
}

// Sifts fresh patch pairs: drops those that planes separate, seeks a witness in the others, and
// keeps them. The plane that held last is tried on all of them first: it often holds for
// neighbours.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__sift_patch_pairs(nsvcd__solver *w,
                                                              nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  const int tells_more = p->goal.measure > 0 || p->goal.first > 0;
  // the first contact of a straight motion follows from its triangles
  const int follows = p->goal.first > 0 && p->arcs.motion->ticks == 1 &&
                      nsvcd__is_straight(nsvcd__arc_at(&p->arcs, 0));
  size_t count = 0;
  nsvcd__clip_segment(w, q);
  const uint32_t plane = w->memo.plane;
  for (size_t n = 0; n < w->fresh_count; n++) {
    if (nsvcd__held_again(w, q, &w->fresh[n])) continue;
    w->fresh[count++] = w->fresh[n];
  }
  w->fresh_count = 0;
  nsvcd__sort_patch_pairs(p, w->fresh, count);
  if (count > 0 && w->fresh[0].depth > NSVCD__DEEP && !follows &&
      nsvcd__seek_in_patch_pair(w, q, &w->fresh[0]) == NSVCD__ANSWERED)
    return NSVCD__ANSWERED;

  for (size_t n = 0; n < count; n++) {
    nsvcd__patch_pair *patches = &w->fresh[n];
    if (nsvcd__check_budget(p)) return NSVCD__EXHAUSTED;
    nsvcd__clip_segment(w, q);
    if (!nsvcd__matters(p, q, patches->segment)) continue;
    // by a plane found since
    if (w->memo.plane != plane && nsvcd__held_again(w, q, patches)) continue;
    if (nsvcd__is_separated(w, q, patches)) continue;
    double u;
    const uint32_t first = nsvcd__arc_of(p->arcs.motion, q->begin[patches->segment], &u);
    if ((p->goal.first > 0 || p->shared > 0) &&
        nsvcd__is_straight(nsvcd__arc_at(&p->arcs, first))) {
      const nsvcd__outcome outcome = nsvcd__resolve_patch_pair(w, q, patches);
      if (outcome != NSVCD__DONE) return outcome;
      continue;
    }
    if (w->misses >= NSVCD__FEW_MISSES) {
      const nsvcd__interval *over = nsvcd__segment_interval(w, q, patches->segment);
      const nsvcd__outcome by_triangles =
          nsvcd__resolve_triangles(w, patches->moving, patches->fixed, over, 0, 0, 0);
      if (by_triangles == NSVCD__DONE) continue;
    }
    const int may_meet = tells_more || w->misses < NSVCD__MANY_MISSES;
    if (may_meet && !patches->sought &&
        nsvcd__seek_in_patch_pair(w, q, patches) == NSVCD__ANSWERED)
      return NSVCD__ANSWERED;
    w->misses++;
    if (w->count == NSVCD__PATCH_PAIRS) {
      const nsvcd__outcome outcome = nsvcd__resolve_patch_pairs(w, q);
      if (outcome != NSVCD__DONE) return outcome;
    }
    p->of.kept.pairs[w->count++] = *patches;
  }
  return NSVCD__DONE;
}

// Is there room for contacts, and can those that were collected still be undone?
static int nsvcd__collects_on(const nsvcd__proof *p) {
  return p->push.contact_count < NSVCD__TOUCHES && !p->push.too_deep;
}

// Collects the contacts of fresh patch pairs at the start, or lists them. EXHAUSTED: there is no
// room for more, or no budget.
static nsvcd__outcome nsvcd__collect_contacts(nsvcd__solver *w, const nsvcd__search *q) {
  nsvcd__proof *p = &w->p;
  for (size_t n = 0; n < w->fresh_count && nsvcd__collects_on(p); n++) {
    const nsvcd__patch_pair *patches = &w->fresh[n];
    if (nsvcd__held_again(w, q, patches)) continue;
    if (nsvcd__is_separated(w, q, patches)) continue;
    if (p->goal.collects == NSVCD__TOUCHING) {
      if (p->push.normal_count > 0) {
        // just pushed out: farther than the clearance by less than floats can tell
        (void)nsvcd__arc_at(&p->arcs, 0);
        if (nsvcd__patches_apart(p, patches->moving, patches->fixed, 0, 0)) continue;
      }
      (void)nsvcd__find_witness(w, patches->moving, patches->fixed, 0, 0);
    } else {
      const uint32_t before = p->near_list.count;
      (void)nsvcd__find_witness(w, patches->moving, patches->fixed, 0, 0);
      if (p->near_list.count > before) {
        nsvcd__hold_plane(&w->memo, nsvcd__f3_round(p->separating));
      }
    }
  }
  w->fresh_count = 0;
  const int goes_on = nsvcd__collects_on(p) && p->work <= p->goal.limit;
  return goes_on ? NSVCD__DONE : NSVCD__EXHAUSTED;
}
#endif  // NSVCD_NO_PROOF
