// In: a question, and the segments chosen of a motion or of an interval of it. Out: do the bodies
// meet; where asked, when first, and how near they come.
#pragma once
#include "../entry/processor.h"
#include "../proof/touches.h"

#ifndef NSVCD_NO_PROOF
// A component is inside the other body. That replaces any contact found since.
static nsvcd__finding nsvcd__found_inside(nsvcd__proof *p) {
  memset(&p->known.found, 0, sizeof p->known.found);
  p->known.found.point = p->enclosed;
  p->known.found.moving_triangle = NSVCD_NO_TRIANGLE;
  p->known.found.fixed_triangle = NSVCD_NO_TRIANGLE;
  return NSVCD__FOUND_INSIDE;
}

// The tick before which nothing meets, or NEVER.
static double nsvcd__clear_until(const nsvcd__proof *p) {
  if (p->unclear) return 0;
  return nsvcd__min(nsvcd__min(p->ask.end, p->known.unresolved),
                    p->known.ran_out ? p->known.resolved : NSVCD__NEVER);
}

// Forgets all that was known of a motion, or of an interval.
static void nsvcd__proof_restart(nsvcd__proof *p) {
  memset(&p->known, 0, sizeof p->known);
  p->known.resolved = (double)p->ask.motion->from;
  p->ask.end = p->clipped_end = p->known.unresolved = NSVCD__NEVER;
  p->ask.unresolved_ends = 0;
  p->clipped = 0;
  p->arc.ticks = 0;
  p->count = p->fresh_count = p->misses = p->contact_count = 0;
  p->too_deep = 0;
  nsvcd__forget(&p->memo);
}

// Searches a motion whose segments have been chosen, and resolves what it finds.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__prove_motion(nsvcd__proof *p, nsvcd__search *q) {
  p->ask.first = p->ask.fraction * (double)p->ask.motion->ticks;
  const nsvcd__outcome outcome = p->kernels->separate(p, q);
  p->known.ran_out = outcome == NSVCD__EXHAUSTED;
  return outcome;
}

// The same for any motion, from scratch.
static nsvcd__outcome nsvcd__prove_anew(nsvcd__proof *p, nsvcd__search *q) {
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, q);
  return nsvcd__prove_motion(p, q);
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

// Do triangles meet at the start alone, or at the end? Takes so many units at most. If they do,
// that is the known contact; if not, all that was known is lost.
static NSVCD__NOINLINE int nsvcd__meets_at(nsvcd__proof *p, nsvcd__search *q, int at_end,
                                           size_t units) {
  const nsvcd__asked asked = p->ask;
  nsvcd__motion still = nsvcd__end_of(asked.motion, at_end);
  p->ask.motion = &still;
  p->ask.fraction = 0;
  p->ask.limit = nsvcd__limit_after(p, units);
  p->ask.is_brief = 1;
  const int meets = nsvcd__prove_anew(p, q) == NSVCD__ANSWERED;
  p->known.found.tick = at_end ? (double)asked.motion->ticks : 0;
  p->ask = asked;
  p->ask.end = 0;
  return meets;
}

// Searches segments that have been chosen, first with a small budget: most queries end there. Many
// of the rest touch only at the start or at the end, so these two poses are tried before all is
// searched again. The search for a first contact begins at the start anyway, and the ends of a long
// motion have been tried before its intervals.
static nsvcd__outcome nsvcd__prove_whole(nsvcd__proof *p, nsvcd__search *q, size_t limit) {
  const int is_brief = !p->ask.motion->arcs && !(p->ask.fraction > 0);
  p->ask.is_brief = is_brief && p->work + NSVCD__BRIEF_BUDGET < limit;
  p->ask.limit = p->ask.is_brief ? p->work + NSVCD__BRIEF_BUDGET : limit;
  const nsvcd__outcome outcome = nsvcd__prove_motion(p, q);
  if (outcome != NSVCD__EXHAUSTED || !p->ask.is_brief) return outcome;
  // half of what may follow an unresolved pair has been used
  if (p->known.unresolved < NSVCD__NEVER)
    p->ask.after_unresolved -= p->ask.after_unresolved / 2;
  for (int at_end = 0; at_end < 2; at_end++) {
    if (nsvcd__meets_at(p, q, at_end, NSVCD__END_BUDGET)) return NSVCD__ANSWERED;
  }
  p->ask.is_brief = 0;
  p->ask.limit = limit;
  return nsvcd__prove_anew(p, q);
}

// Searches a part of the motion, from one position in segments to another, for the first contact
// there or the first unresolved pair, and adds what it finds to what is known of all before it.
// *end: the tick from which on nothing matters.
static void nsvcd__prove_part(nsvcd__proof *p, nsvcd__search *q, double from, double to,
                              nsvcd__known *known, double *end) {
  const nsvcd__known *part = &p->known;
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, q);
  // this many ticks to one of before
  const double finer = nsvcd__motion_refine(p->ask.motion);
  nsvcd__narrow_segments(q, from, to, finer);
  p->ask.end = nsvcd__min(p->ask.end, finer * *end);
  p->ask.unresolved_ends = 1;
  (void)nsvcd__prove_motion(p, q);
  const double last = (double)q->begin[q->segments];
  if (part->has_contact) {
    known->has_contact = 1;
    known->found = part->found;
    known->found.tick /= finer;
    *end = p->ask.end / finer;
  }
  if (part->ran_out) return;
  if (part->unresolved < NSVCD__NEVER) {
    known->unresolved_pair = part->unresolved_pair;
    known->unresolved_pair.tick /= finer;
    known->unresolved = part->unresolved / finer;
  }
  known->resolved = nsvcd__min(last, p->ask.end) / finer;
}

// The budget did not suffice for the first contact. Searches again by time, from what is resolved
// on: one part of the motion after another, a shorter one where a part takes too many units.
static NSVCD__NOINLINE void nsvcd__prove_by_time(nsvcd__proof *p, nsvcd__search *q,
                                                 size_t limit) {
  nsvcd__known known = p->known;
  const double ticks = (double)p->ask.motion->ticks;
  const double all = (double)q->segments;
  double end = p->ask.end;
  double from = 0;
  double length = NSVCD__FIRST_PART;
  double grows = 4;
  size_t units = limit;
  while (from < all && (double)q->begin[(size_t)from + 1] <= known.resolved) from++;
  p->ask.is_brief = 1;
  for (;;) {
    const double until = nsvcd__min(ticks, nsvcd__min(end, known.unresolved));
    known.ran_out = known.resolved < until;
    if (!known.ran_out || p->work >= limit) break;
    const size_t before = p->work;
    const double whole = floor(from + length);
    const double to = whole > from ? nsvcd__min(whole, all) : from + length;
    p->ask.limit = limit - before > units ? before + units : limit;
    nsvcd__prove_part(p, q, from, to, &known, &end);
    if (p->known.ran_out) {
      length /= 8;
      grows = 2;
    } else {
      from = to;
      length *= grows;
      units = 8 * (p->work - before) + NSVCD__PART_BUDGET;
    }
  }
  p->ask.is_brief = 0;
  nsvcd__proof_restart(p);
  nsvcd__choose_segments(p->ask.motion, q);
  p->known = known;
  p->ask.end = end;
}

// When do they meet first? What is proven of that stays proven when the budget ends.
static nsvcd__outcome nsvcd__prove_first(nsvcd__proof *p, nsvcd__search *q) {
  const nsvcd__outcome outcome = nsvcd__prove_whole(p, q, nsvcd__limit_of_first(p));
  const double from = (double)p->ask.motion->from;
  // An interval is short, and all before it is known.
  if (p->known.ran_out && !p->ask.motion->arcs) nsvcd__prove_by_time(p, q, p->ask.most);
  const nsvcd__known known = p->known;
  const double end = p->ask.end;
  if (from > 0 && known.has_contact) {
    p->starts_free = 1;
  } else if (known.has_contact && nsvcd__clear_until(p) <= 0 && known.found.tick > 0) {
    // The contact is so early that they may meet at the start already.
    if (nsvcd__meets_at(p, q, 0, p->given.work)) return NSVCD__ANSWERED;
    p->starts_free = !p->known.ran_out && !(p->known.unresolved < NSVCD__NEVER);
    p->known = known;
    p->ask.end = end;
  }
  return outcome;
}

// ---- the least distance

// One pass: a search whose question shrinks, for a bracket as narrow as p->ask.measure. Adds what
// it finds to what is known. Returns whether the budget sufficed; if so, they come no nearer than
// p->low.
static int nsvcd__measure_once(nsvcd__proof *p, nsvcd__search *q) {
  nsvcd__known known = p->known;
  const int is_named = known.has_contact || known.unresolved < NSVCD__NEVER;
  p->ask.clearance = is_named ? nsvcd__max(p->low, p->high - p->ask.measure) : p->high;
  nsvcd__proof_restart(p);
  const nsvcd__outcome pass = nsvcd__prove_motion(p, q);
  if (p->known.has_contact) {
    known.has_contact = 1;
    known.found = p->known.found;
  }
  p->known = known;
  if (pass != NSVCD__EXHAUSTED) p->low = p->ask.clearance;
  return pass != NSVCD__EXHAUSTED;
}

// Makes the bracket as narrow as `finest`. If half of the budget does not suffice for that, the
// rest goes to brackets that get narrower and narrower; the last that was completed stays.
static void nsvcd__narrow(nsvcd__proof *p, nsvcd__search *q, double finest) {
  p->ask.measure = finest;
  p->ask.limit = nsvcd__limit_after(p, p->given.work / 2);
  if (nsvcd__measure_once(p, q)) return;
  p->ask.limit = p->ask.most;
  p->ask.measure = p->high - p->low;
  while (!p->wide && p->ask.measure > finest) {
    p->ask.measure = nsvcd__max(finest, p->ask.measure / NSVCD__FINER);
    p->wide = !nsvcd__measure_once(p, q);
  }
}
#endif  // NSVCD_NO_PROOF
