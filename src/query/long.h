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
static float nsvcd__surface_gap(const nsvcd__proof *p, const nsvcd__motion *m,
                                float origin_gap) {
  return origin_gap - p->given.lengths - 1.0001f * nsvcd__f3_norm(m->push_out);
}

// Searches a motion interval by interval, until a contact answers. In the end that contact is
// known, and all else that is known is of the first interval that was not resolved.
static NSVCD__NOINLINE nsvcd__search_result nsvcd__search_intervals(nsvcd__solver *w,
                                                                    nsvcd__search *q,
                                                                    nsvcd__goal goal) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  double fraction = goal.fraction;  // 0: any contact will do
  const nsvcd__given *given = &p->given;
  nsvcd__search_result result = p->known;
  nsvcd__search_result open = result;
  int is_open = 0;
  const size_t units = given->reserve < NSVCD__END_BUDGET ? given->reserve : NSVCD__END_BUDGET;
  for (int at_end = 0; at_end < 2 && !(fraction > 0); at_end++) {
    if (nsvcd__meets_at(w, q, goal, at_end, units, &result)) return result;
  }
  nsvcd__pace pace = {0, 1};
  nsvcd__choose_interval(m, q, 0, NSVCD__ALL_ARCS);
  while (m->from < m->ticks) {
    const uint32_t until = q->begin[q->segments];
    const int is_try = m->arcs > 1;
    const size_t before = p->work;
    if (given->grows) goal.most = p->work + given->work;
    nsvcd__restart(w, m);
    result = p->known;
    const float gap = nsvcd__interval_gap(m, m->from, until);
    if (!(nsvcd__surface_gap(p, m, gap) > nsvcd__clearance(&goal))) {
      goal.is_brief = is_try;
      goal.fraction = is_try ? 0 : fraction;
      goal.after_unresolved = fraction > 0 ? NSVCD__AFTER_FIRST_UNRESOLVED : given->reserve;
      goal.limit = is_try ? nsvcd__limit_after(p, &goal, NSVCD__TRY) : goal.most;
      result = goal.fraction > 0 ? nsvcd__search_first(w, q, goal)
                                 : NSVCD__KERNEL(w->isa, separate)(w, q, &goal);
    }
    const int is_resolved =
        result.outcome == NSVCD__DONE && !(result.unresolved < NSVCD__NEVER);
    const int has_contact = result.has_contact && !(is_try && fraction > 0);
    if (is_open && has_contact) {
      open.has_contact = 1;
      open.found = result.found;
    }
    if (!is_open && !is_try && !is_resolved && !has_contact) {
      open = result;
      open.outcome = NSVCD__DONE;
      is_open = 1;
      fraction = 0;
    }
    if (has_contact || (is_open && !given->grows && p->work > goal.most)) break;
    nsvcd__next_interval(m, q, until, is_resolved || !is_try, p->work - before, &pace);
  }
  return is_open ? open : result;
}

// A component is inside the other body. That replaces any contact found since.
static nsvcd__finding nsvcd__found_inside(const nsvcd__solver *w,
                                          nsvcd__search_result *result) {
  memset(&result->found, 0, sizeof result->found);
  result->found.point = w->enclosed;
  result->found.moving_triangle = NSVCD_NO_TRIANGLE;
  result->found.fixed_triangle = NSVCD_NO_TRIANGLE;
  return NSVCD__FOUND_INSIDE;
}

// Do the bodies meet, and when? goal: of all of the motion. *result: what is known of it.
static nsvcd__finding nsvcd__prove(nsvcd__solver *w, nsvcd__search *q, nsvcd__goal goal,
                                   nsvcd__search_result *result) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  const int in_order = goal.fraction > 0;
  const float gap = nsvcd__surface_gap(p, m, nsvcd__motion_gap(m));
  *result = p->known;
  if (gap > nsvcd__clearance(&goal)) return NSVCD__FOUND_FREE;
  const int is_long = nsvcd__is_long(m, q);
  if (!p->given.surfaces && NSVCD__KERNEL(w->isa, is_contained_at_start)(w)) {
    // It is a hit. A question that asks for more gets triangles, if some meet as well.
    const size_t units = NSVCD__INSIDE_BUDGET;
    const int meets = p->given.tells && nsvcd__meets_at(w, q, goal, 0, units, result);
    return meets ? NSVCD__FOUND_CONTACT : nsvcd__found_inside(w, result);
  }
  *result = is_long    ? nsvcd__search_intervals(w, q, goal)
            : in_order ? nsvcd__search_first(w, q, goal)
                       : nsvcd__search_whole(w, q, goal);
  const double clear = nsvcd__clear_until(w, result);
  if (result->outcome == NSVCD__ANSWERED) return NSVCD__FOUND_CONTACT;
  if (w->inside && clear > 0) return nsvcd__found_inside(w, result);
  if (result->has_contact) return NSVCD__FOUND_CONTACT;
  if (result->unresolved < NSVCD__NEVER) result->found = result->unresolved_pair;
  return clear < NSVCD__NEVER ? NSVCD__FOUND_UNDECIDED : NSVCD__FOUND_FREE;
}

// ---- the least distance

// Narrows the bracket interval by interval. A budget that was given is divided by time: each
// interval gets of what is left the share that it has of the rest of the motion.
static NSVCD__NOINLINE void nsvcd__narrow_intervals(nsvcd__solver *w, nsvcd__search *q,
                                                    nsvcd__goal goal, double finest,
                                                    nsvcd__bracket *bracket,
                                                    nsvcd__search_result *known) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  const size_t most = goal.most;
  const double known_low = bracket->low;
  size_t work = p->given.work;
  nsvcd__pace pace = {0, 1};
  double low = bracket->high;
  int is_wide = 0;
  while (m->from < m->ticks) {
    const uint32_t until = q->begin[q->segments];
    const size_t before = p->work;
    int is_resolved = 1;
    if (!p->given.grows) {
      const double rest = (double)(until - m->from) / (double)(m->ticks - m->from);
      work = before < most ? (size_t)(rest * (double)(most - before)) : 0;
    }
    goal.most = before + work;
    const float gap = nsvcd__interval_gap(m, m->from, until);
    bracket->low = nsvcd__max(known_low, (double)nsvcd__surface_gap(p, m, gap));
    bracket->is_wide = 0;
    const int is_narrow = nsvcd__has_pair(known) && bracket->high - bracket->low <= finest;
    if (bracket->low < bracket->high && !is_narrow) {
      if (m->arcs > 1) {
        goal.measure = finest;
        goal.limit = nsvcd__limit_after(p, &goal, NSVCD__TRY);
        is_resolved = nsvcd__measure_once(w, q, goal, bracket, known);
      } else {
        nsvcd__narrow(w, q, goal, work, finest, bracket, known);
      }
    }
    if (is_resolved) low = nsvcd__min(low, bracket->low);
    is_wide |= bracket->is_wide;
    nsvcd__next_interval(m, q, until, is_resolved, p->work - before, &pace);
  }
  bracket->low = nsvcd__min(low, bracket->high);
  bracket->is_wide = is_wide && bracket->high - bracket->low > finest;
}

// Brackets the least distance over the motion, once it is known whether the bodies come within the
// clearance.
static NSVCD__NOINLINE nsvcd__bracket nsvcd__measure(nsvcd__solver *w, nsvcd__search *q,
                                                     nsvcd__goal goal, nsvcd__finding verdict,
                                                     nsvcd__search_result *known) {
  nsvcd__proof *p = &w->p;
  nsvcd__motion *m = goal.motion;
  const double finest = p->given.width;
  int is_named = nsvcd__has_pair(known);
  const float gap = nsvcd__surface_gap(p, m, nsvcd__motion_gap(m));
  const double clear = verdict == NSVCD__FOUND_FREE ? p->given.clearance : 0;
  nsvcd__bracket bracket = {nsvcd__max(clear, (double)gap), known->found.distance, 0};
  const int is_long = nsvcd__is_long(m, q);
  if (is_long) nsvcd__choose_interval(m, q, 0, NSVCD__ALL_ARCS);
  if (!is_named) {
    bracket.high = NSVCD__KERNEL(w->isa, bound_distance)(w, q);
    is_named = known->has_contact = p->known.has_contact;
    known->found = p->known.found;
  }
  if (is_named && !(bracket.high - bracket.low > finest)) return bracket;
  if (is_long)
    nsvcd__narrow_intervals(w, q, goal, finest, &bracket, known);
  else
    nsvcd__narrow(w, q, goal, p->given.work, finest, &bracket, known);
  return bracket;
}
#endif  // NSVCD_NO_PROOF
