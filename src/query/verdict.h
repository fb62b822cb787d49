// In: a goal, and the segments chosen of a motion or of an interval of it. Out: a result: do the
// bodies meet; where asked, when first, and how near they come.
//
// Goals and results are values. What stands here and above asks the waist, the kernel
// nsvcd__separate, with goals of its own, and writes nothing into the proof but whose motion it is
// about.
#pragma once
#include "../entry/processor.h"

#ifndef NSVCD_NO_PROOF
// The tick before which nothing meets, or NEVER.
static double nsvcd__clear_until(const nsvcd__solver *w, const nsvcd__search_result *r) {
  if (w->unclear) return 0;
  return nsvcd__min(nsvcd__min(r->end, r->unresolved),
                    r->ran_out ? r->proven_until : NSVCD__NEVER);
}

// Has a search found two triangles that can be named: in contact, or too near to tell?
static int nsvcd__has_pair(const nsvcd__search_result *r) {
  return r->has_contact || r->unresolved < NSVCD__NEVER;
}

// Forgets all that was known of a motion, or of an interval, before another one is searched.
static void nsvcd__restart(nsvcd__solver *w, nsvcd__motion *motion) {
  nsvcd__proof *p = &w->p;
  memset(&p->known, 0, sizeof p->known);
  nsvcd__arcs_begin(&p->arcs, motion);
  p->known.proven_until = (double)motion->from;
  p->known.end = w->clipped_end = p->known.unresolved = NSVCD__NEVER;
  w->clipped = 0;
  w->count = w->fresh_count = w->misses = p->push.contact_count = 0;
  p->shared = w->blocks.window = 0;
  p->push.too_deep = w->blocks.has_block = 0;
  p->separating = nsvcd__d3_of(0, 0, 0);
  w->memo.intervals = w->memo.plane = 0;
  w->memo.held = nsvcd__f3_of(0, 0, 0);
}

// Searches any motion, from scratch.
static nsvcd__search_result nsvcd__search_anew(nsvcd__solver *w, nsvcd__search *q,
                                               nsvcd__goal goal) {
  nsvcd__restart(w, goal.motion);
  nsvcd__choose_segments(goal.motion, q);
  return NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
}

// The pose at the start of a motion, or at its end, as a motion of its own.
static nsvcd__motion nsvcd__end_of(const nsvcd__motion *m, int at_end) {
  nsvcd__motion still = *m;
  nsvcd__track moving = m->moving;
  nsvcd__track fixed = m->fixed;
  moving.poses += at_end ? moving.count - 1 : 0;
  fixed.poses += at_end ? fixed.count - 1 : 0;
  moving.count = fixed.count = 1;
  moving.times = fixed.times = NULL;
  still.begin = at_end ? 1 : 0;
  still.duration = 0;
  nsvcd__motion_set_tracks(&still, moving, fixed);
  return still;
}

// Do triangles meet at the start alone, or at the end? Takes so many units at most. If they do, the
// result is that contact.
static NSVCD__NOINLINE int nsvcd__meets_at(nsvcd__solver *w, nsvcd__search *q,
                                           nsvcd__goal goal, int at_end, size_t units,
                                           nsvcd__search_result *out) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *whole = goal.motion;
  nsvcd__motion still = nsvcd__end_of(whole, at_end);
  goal.motion = &still;
  goal.fraction = 0;
  goal.limit = nsvcd__limit_after(p, &goal, units);
  goal.is_brief = 1;
  const nsvcd__search_result at = nsvcd__search_anew(w, q, goal);
  nsvcd__arcs_begin(&p->arcs, whole);
  if (at.outcome != NSVCD__ANSWERED) return 0;
  *out = at;
  out->found.tick = at_end ? (double)whole->ticks : 0;
  out->end = 0;
  return 1;
}

// Searches segments that have been chosen, first with a small budget: most queries end there. Many
// of the rest touch only at the start or at the end, so these two poses are tried before all is
// searched again. The search for a first contact begins at the start anyway, and the ends of a long
// motion have been tried before its intervals.
static nsvcd__search_result nsvcd__search_whole(nsvcd__solver *w, nsvcd__search *q,
                                                nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  const size_t limit = goal.limit;
  const int may_be_brief = !goal.motion->arcs && !(goal.fraction > 0);
  goal.is_brief = may_be_brief && p->work + NSVCD__BRIEF_BUDGET < limit;
  if (goal.is_brief) goal.limit = p->work + NSVCD__BRIEF_BUDGET;
  nsvcd__search_result result = NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
  if (result.outcome != NSVCD__EXHAUSTED || !goal.is_brief) return result;
  // half of what may follow an unresolved pair has been used
  if (result.unresolved < NSVCD__NEVER) goal.after_unresolved -= goal.after_unresolved / 2;
  for (int at_end = 0; at_end < 2; at_end++) {
    if (nsvcd__meets_at(w, q, goal, at_end, NSVCD__END_BUDGET, &result)) return result;
  }
  goal.is_brief = 0;
  goal.limit = limit;
  return nsvcd__search_anew(w, q, goal);
}

// Searches a part of the motion, from one position in segments to another, for the first contact
// there or the first unresolved pair, and adds what it finds to what is known of all before it.
static void nsvcd__search_part(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal,
                               double from, double to, nsvcd__search_result *known) {
  nsvcd__restart(w, goal.motion);
  nsvcd__choose_segments(goal.motion, q);
  // this many ticks to one of before
  const double finer = nsvcd__motion_refine(goal.motion);
  nsvcd__narrow_segments(q, from, to, finer);
  goal.end = nsvcd__min(NSVCD__NEVER, finer * known->end);
  goal.unresolved_ends = 1;
  const nsvcd__search_result part = NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
  if (part.has_contact) {
    known->has_contact = 1;
    known->found = part.found;
    known->found.tick /= finer;
    known->end = part.end / finer;
  }
  known->ran_out = part.ran_out;
  if (part.ran_out) return;
  if (part.unresolved < NSVCD__NEVER) {
    known->unresolved_pair = part.unresolved_pair;
    known->unresolved_pair.tick /= finer;
    known->unresolved = part.unresolved / finer;
  }
  known->proven_until = nsvcd__min((double)q->begin[q->segments], part.end) / finer;
}

// The budget did not suffice for the first contact. Searches again by time, from what is proven on:
// one part of the motion after another, a shorter one where a part takes too many units.
static NSVCD__NOINLINE void nsvcd__search_by_time(nsvcd__solver *w, nsvcd__search *q,
                                                  nsvcd__goal goal,
                                                  nsvcd__search_result *known) {
  nsvcd__proof *p = &w->p;
  const size_t limit = goal.most;
  const double ticks = (double)goal.motion->ticks;
  const double all = (double)q->segments;
  double from = 0;
  double length = NSVCD__FIRST_PART;
  double grows = 4;
  size_t units = limit;
  while (from < all && (double)q->begin[(size_t)from + 1] <= known->proven_until) from++;
  goal.is_brief = 1;
  for (;;) {
    const double until = nsvcd__min(ticks, nsvcd__min(known->end, known->unresolved));
    known->ran_out = known->proven_until < until;
    if (!known->ran_out || p->work >= limit) break;
    const size_t before = p->work;
    const double whole = floor(from + length);
    const double to = whole > from ? nsvcd__min(whole, all) : from + length;
    goal.limit = limit - before > units ? before + units : limit;
    nsvcd__search_part(w, q, goal, from, to, known);
    if (known->ran_out) {
      length /= 8;
      grows = 2;
    } else {
      from = to;
      length *= grows;
      units = 8 * (p->work - before) + NSVCD__PART_BUDGET;
    }
  }
  nsvcd__restart(w, goal.motion);
  nsvcd__choose_segments(goal.motion, q);
}

// When do they meet first? What is proven of that stays proven when the budget ends.
static nsvcd__search_result nsvcd__search_first(nsvcd__solver *w, nsvcd__search *q,
                                                nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  goal.limit = nsvcd__limit_of_first(&p->given, &goal);
  nsvcd__search_result result = nsvcd__search_whole(w, q, goal);
  // An interval is short, and all before it is known.
  if (result.ran_out && !goal.motion->arcs) nsvcd__search_by_time(w, q, goal, &result);
  if (!result.has_contact) return result;
  if (goal.motion->from > 0) {
    result.starts_free = 1;
  } else if (nsvcd__clear_until(w, &result) <= 0 && result.found.tick > 0) {
    // The contact is so early that they may meet at the start already.
    if (nsvcd__meets_at(w, q, goal, 0, p->given.work, &result)) return result;
    result.starts_free = !p->known.ran_out && !(p->known.unresolved < NSVCD__NEVER);
  }
  return result;
}

// ---- the least distance

// The bracket of the least distance.
typedef struct nsvcd__bracket {
  double low, high;
  // the budget did not suffice for the resolution asked for
  int is_wide;
} nsvcd__bracket;

// One pass: a search whose question shrinks, for a bracket as narrow as goal.measure. Adds what it
// finds to what is known, and narrows the bracket. Returns 0 if the budget did not suffice.
static int nsvcd__measure_once(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal,
                               nsvcd__bracket *bracket, nsvcd__search_result *known) {
  goal.low = bracket->low;
  goal.high = bracket->high;
  goal.clearance =
      nsvcd__has_pair(known) ? nsvcd__max(goal.low, goal.high - goal.measure) : goal.high;
  nsvcd__restart(w, goal.motion);
  const nsvcd__search_result pass = NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
  if (pass.has_contact) {
    known->has_contact = 1;
    known->found = pass.found;
    bracket->high = pass.found.distance;
  }
  if (pass.outcome == NSVCD__EXHAUSTED) return 0;
  bracket->low = pass.clearance;
  return 1;
}

// Makes the bracket as narrow as `finest`. If half of the budget does not suffice for that, the
// rest goes to brackets that get narrower and narrower; the last that was completed stays. work:
// the budget.
static void nsvcd__narrow(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal, size_t work,
                          double finest, nsvcd__bracket *bracket,
                          nsvcd__search_result *known) {
  goal.measure = finest;
  goal.limit = nsvcd__limit_after(&w->p, &goal, work / 2);
  if (nsvcd__measure_once(w, q, goal, bracket, known)) return;
  goal.limit = goal.most;
  goal.measure = bracket->high - bracket->low;
  while (!bracket->is_wide && goal.measure > finest) {
    goal.measure = nsvcd__max(finest, goal.measure / NSVCD__FINER);
    bracket->is_wide = !nsvcd__measure_once(w, q, goal, bracket, known);
  }
}
#endif  // NSVCD_NO_PROOF
