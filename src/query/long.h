// In: a question about a motion of any length. Out: the verdict; where asked, when the bodies first
// meet, and how near they come.
//
// A motion that is too long for one search (motion/choice) is searched interval by interval, in the
// order of time, each as if it were all of the motion: memory is needed for one. The motion is free
// if all intervals are. Containment is decided once, at t = 0: what is inside of what later on, and
// not then, has crossed a surface in between. A contact in any interval answers a yes or no, so the
// ends of the motion, where most contacts are, are tried first. The first contact is in the first
// interval that has one. An interval that stays unresolved before it ends what is proven, and from
// there on the question is only whether they meet at all. For the least distance each contact
// lowers the bound, and later intervals need only stay beyond it.
//
// Most of a long motion is far from anything, or easy. So a *try* takes many more arcs than an
// interval has, with a small budget. If that does not suffice, it is searched in smaller parts.
#pragma once
#include "verdict.h"

#ifndef NSVCD_NO_PROOF
// How fast intervals go through a motion: how many in a row have been easy, and how many must be
// before the next try.
typedef struct nsvcd__pace {
  uint32_t easy, wait;
} nsvcd__pace;

// The arcs of the first interval: all of the motion, as a try.
#define NSVCD__ALL_ARCS 0xffffffffu

// Chooses the next interval: larger if those before took little work; with segments that turn less
// if the one before took much; a part of a try that failed.
static void nsvcd__next_interval(nsvcd__motion *m, nsvcd__search *q, uint32_t until,
                                 int is_resolved, size_t units, nsvcd__pace *pace) {
  uint32_t arcs = m->arcs;
  if (!is_resolved) {
    arcs = arcs > NSVCD__SMALLER ? arcs / NSVCD__SMALLER : 1;
    if (arcs == 1 && pace->wait < NSVCD__WAIT) pace->wait *= 2;
    pace->easy = 0;
  } else if (arcs > 1) {
    arcs *= NSVCD__LARGER;
    pace->wait = 1;
  } else {
    pace->easy = units <= NSVCD__EASY ? pace->easy + 1 : 0;
    if (pace->easy >= pace->wait) arcs = NSVCD__LARGER;
    m->is_fine = units > NSVCD__TRY;
  }
  if (is_resolved) m->from = until;
  if (m->from < m->ticks) nsvcd__choose_interval(m, q, m->from, arcs);
}

// The surfaces of bodies whose origins stay so far apart come no nearer than this.
static float nsvcd__surface_gap(const nsvcd__proof *p, float origin_gap) {
  const float pushed_out = 1.0001f * nsvcd__f3_norm(p->ask.motion->push_out);
  return origin_gap - p->given.lengths - pushed_out;
}

// Searches a motion interval by interval, until a contact answers. In the end that contact is
// known, and all else that is known is of the first interval that was not resolved.
static NSVCD__NOINLINE nsvcd__outcome nsvcd__prove_intervals(nsvcd__proof *p,
                                                             nsvcd__search *q) {
  nsvcd__motion *m = p->ask.motion;
  const double asked = p->ask.fraction;
  nsvcd__outcome outcome = NSVCD__DONE;
  nsvcd__known open = p->known;
  double end = NSVCD__NEVER;
  double fraction = asked;  // 0: any contact will do
  int is_open = 0;
  const size_t units =
      p->given.reserve < NSVCD__END_BUDGET ? p->given.reserve : NSVCD__END_BUDGET;
  for (int at_end = 0; at_end < 2 && !(asked > 0); at_end++) {
    if (nsvcd__meets_at(p, q, at_end, units)) return NSVCD__ANSWERED;
  }
  nsvcd__pace pace = {0, 1};
  nsvcd__choose_interval(m, q, 0, NSVCD__ALL_ARCS);
  while (m->from < m->ticks) {
    const uint32_t until = q->begin[q->segments];
    const int is_try = m->arcs > 1;
    const size_t before = p->work;
    if (p->given.grows) p->ask.most = p->work + p->given.work;
    nsvcd__proof_restart(p);
    outcome = NSVCD__DONE;
    const float gap = nsvcd__interval_gap(m, m->from, until);
    if (!(nsvcd__surface_gap(p, gap) > nsvcd__clearance(p))) {
      p->ask.is_brief = is_try;
      p->ask.fraction = is_try ? 0 : fraction;
      p->ask.after_unresolved =
          fraction > 0 ? NSVCD__AFTER_FIRST_UNRESOLVED : p->given.reserve;
      p->ask.limit = is_try ? nsvcd__limit_after(p, NSVCD__TRY) : p->ask.most;
      outcome = p->ask.fraction > 0 ? nsvcd__prove_first(p, q) : nsvcd__prove_motion(p, q);
    }
    const int is_resolved = outcome == NSVCD__DONE && !(p->known.unresolved < NSVCD__NEVER);
    const int has_contact = p->known.has_contact && !(is_try && fraction > 0);
    if (is_open && has_contact) {
      open.has_contact = 1;
      open.found = p->known.found;
    }
    if (!is_open && !is_try && !is_resolved && !has_contact) {
      open = p->known;
      end = p->ask.end;
      is_open = 1;
      fraction = 0;
    }
    if (has_contact || (is_open && !p->given.grows && p->work > p->ask.most)) break;
    nsvcd__next_interval(m, q, until, is_resolved || !is_try, p->work - before, &pace);
  }
  p->ask.is_brief = 0;
  p->ask.fraction = asked;
  if (!is_open) return outcome;
  p->known = open;
  p->ask.end = end;
  return NSVCD__DONE;
}

// Answers a question: do the bodies meet, and when?
static nsvcd__finding nsvcd__prove(nsvcd__proof *p, nsvcd__search *q) {
  nsvcd__motion *m = p->ask.motion;
  const int in_order = p->ask.fraction > 0;
  const float gap = nsvcd__surface_gap(p, nsvcd__motion_gap(m));
  p->ask.limit = p->given.work;
  p->ask.after_unresolved = in_order ? NSVCD__AFTER_FIRST_UNRESOLVED : p->given.reserve;
  if (gap > nsvcd__clearance(p)) return NSVCD__FOUND_FREE;
  const int is_long = nsvcd__is_long(m, q);
  if (p->kernels->is_contained_at_start(p)) {
    // It is a hit. A question that asks for more gets triangles, if some meet as well.
    const int meets = p->given.tells && nsvcd__meets_at(p, q, 0, NSVCD__INSIDE_BUDGET);
    return meets ? NSVCD__FOUND_CONTACT : nsvcd__found_inside(p);
  }
  const nsvcd__outcome outcome = is_long    ? nsvcd__prove_intervals(p, q)
                                 : in_order ? nsvcd__prove_first(p, q)
                                            : nsvcd__prove_whole(p, q, p->given.work);
  const double clear = nsvcd__clear_until(p);
  if (outcome == NSVCD__ANSWERED) return NSVCD__FOUND_CONTACT;
  if (p->inside && clear > 0) return nsvcd__found_inside(p);
  if (p->known.has_contact) return NSVCD__FOUND_CONTACT;
  if (p->known.unresolved < NSVCD__NEVER) p->known.found = p->known.unresolved_pair;
  return clear < NSVCD__NEVER ? NSVCD__FOUND_UNDECIDED : NSVCD__FOUND_FREE;
}

// ---- the least distance

// Narrows the bracket interval by interval. A budget that was given is divided by time: each
// interval gets of what is left the share that it has of the rest of the motion.
static NSVCD__NOINLINE void nsvcd__narrow_intervals(nsvcd__proof *p, nsvcd__search *q,
                                                    double finest) {
  nsvcd__motion *m = p->ask.motion;
  const size_t most = p->ask.most;
  const size_t work = p->given.work;
  const double known = p->low;
  nsvcd__pace pace = {0, 1};
  double low = p->high;
  int is_wide = 0;
  while (m->from < m->ticks) {
    const uint32_t until = q->begin[q->segments];
    const size_t before = p->work;
    const int is_named = p->known.has_contact || p->known.unresolved < NSVCD__NEVER;
    int is_resolved = 1;
    if (!p->given.grows) {
      const double rest = (double)(until - m->from) / (double)(m->ticks - m->from);
      p->given.work = p->work < most ? (size_t)(rest * (double)(most - p->work)) : 0;
    }
    p->ask.most = p->work + p->given.work;
    const float gap = nsvcd__interval_gap(m, m->from, until);
    p->low = nsvcd__max(known, (double)nsvcd__surface_gap(p, gap));
    p->wide = 0;
    if (p->low < p->high && !(is_named && p->high - p->low <= finest)) {
      if (m->arcs > 1) {
        p->ask.measure = finest;
        p->ask.limit = nsvcd__limit_after(p, NSVCD__TRY);
        is_resolved = nsvcd__measure_once(p, q);
      } else {
        nsvcd__narrow(p, q, finest);
      }
    }
    if (is_resolved) low = nsvcd__min(low, p->low);
    is_wide |= p->wide;
    nsvcd__next_interval(m, q, until, is_resolved, p->work - before, &pace);
  }
  p->given.work = work;
  p->ask.most = most;
  p->low = nsvcd__min(low, p->high);
  p->wide = is_wide && p->high - p->low > finest;
}

// Brackets the least distance over the motion, once it is known whether they come within the
// clearance.
static NSVCD__NOINLINE void nsvcd__measure(nsvcd__proof *p, nsvcd__search *q,
                                           nsvcd__finding verdict, double finest) {
  nsvcd__motion *m = p->ask.motion;
  int is_named = p->known.has_contact || p->known.unresolved < NSVCD__NEVER;
  const float gap = nsvcd__surface_gap(p, nsvcd__motion_gap(m));
  p->low = nsvcd__max(verdict == NSVCD__FOUND_FREE ? p->given.clearance : 0, (double)gap);
  const int is_long = nsvcd__is_long(m, q);
  if (is_long) nsvcd__choose_interval(m, q, 0, NSVCD__ALL_ARCS);
  p->high = is_named ? p->known.found.distance : p->kernels->bound_distance(p, q);
  is_named = is_named || p->known.has_contact;
  if (is_named && !(p->high - p->low > finest)) return;
  if (is_long)
    nsvcd__narrow_intervals(p, q, finest);
  else
    nsvcd__narrow(p, q, finest);
}
#endif  // NSVCD_NO_PROOF
