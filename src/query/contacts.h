// In: two bodies at rest. Out: where they are near each other, on all sides.
//
// One search lists all triangle pairs that are near. The nearest of them gives the first side, with
// its direction; the nearest of those in other directions the next. A triangle pair is a side only
// if its nearest points are nearest among all triangles about them: the inner edges of a floor have
// directions of their own, which lean to where the floor goes on and is nearer.
#pragma once
#include "../interface/contacts.h"
#include "question.h"

#ifndef NSVCD_NO_PROOF
// Cosine of the angle within which directions are of one side.
#define NSVCD__SAME_SIDE 0.8f

// The nearest triangle pair that has no side yet; NULL: there is none.
static nsvcd__near_pair *nsvcd__next_near(const nsvcd__near_list *list) {
  nsvcd__near_pair *best = NULL;
  for (uint32_t n = 0; n < list->count; n++) {
    nsvcd__near_pair *item = &list->items[n];
    if (!item->is_resolved && (!best || item->distance < best->distance)) best = item;
  }
  return best;
}

// The contacts of the side whose nearest triangle pair this is, with its nearest points: up to
// NSVCD_MAX_CONTACTS, of which one is as near as these. Returns how many.
static size_t nsvcd__contacts_of_side(nsvcd__query *query, const nsvcd__near_pair *item,
                                      const nsvcd__posed_pair *posed,
                                      const nsvcd__nearest *points, double same,
                                      nsvcd_contact *out) {
  nsvcd__proof *p = &query->solver->p;
  const nsvcd__manifold *m = &p->of.kept.manifold;
  int chosen[NSVCD_MAX_CONTACTS];
  const nsvcd__twist rests = {{0, 0, 0}, {0, 0, 0}};
  double area;
  int count = nsvcd__supports_of(p, nsvcd__d3_widen(item->normal), &rests,
                                 (double)NSVCD__SAME_SIDE, same, chosen, &area);
  int closest = -1;  // to the nearest points
  int has_nearest = 0;
  for (int n = 0; n < count; n++) {
    const nsvcd__pair_contact *support = &m->supports[chosen[n]];
    nsvcd__write_contact(query, support, &out[n]);
    out[n].id = m->numbers[chosen[n]] ^ (uint32_t)query->task.swapped;
    has_nearest |= support->distance <= (double)item->distance + nsvcd__epsilon(p);
    const double square = nsvcd__d3_distance2(support->point, points->on_b);
    if (closest < 0 ||
        square < nsvcd__d3_distance2(m->supports[chosen[closest]].point, points->on_b))
      closest = n;
  }
  if (has_nearest) return (size_t)count;
  // It replaces the one beside it, unless there is room.
  if (count < NSVCD_MAX_CONTACTS) closest = count++;
  nsvcd__pair_contact nearest = nsvcd__contact_at(p, &posed->pair, 0, points);
  nearest.normal = nsvcd__d3_widen(item->normal);
  nsvcd__write_contact(query, &nearest, &out[closest]);
  out[closest].id = (item->moving_triangle * 3 + item->fixed_triangle * 5) << 2 | 2;
  return (size_t)count;
}

// Writes the contacts of all sides, the nearest side first. Returns how many.
static size_t nsvcd__write_contacts(nsvcd__query *query, nsvcd_contact *contacts,
                                    size_t most) {
  nsvcd__proof *p = &query->solver->p;
  const nsvcd__near_list *list = &p->near_list;
  const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, 0), 0);
  const double same = nsvcd__epsilon(p) + 1e-5 * (double)p->given.lengths;
  size_t written = 0;
  for (int sides = 0; sides < NSVCD_MAX_SIDES && written < most;) {
    nsvcd_contact found[NSVCD_MAX_CONTACTS];
    nsvcd__posed_pair posed;
    nsvcd__near_pair *item = nsvcd__next_near(list);
    if (!item) break;
    item->is_resolved = 1;
    nsvcd__posed_pair_of(p, &at, item, &posed);
    const nsvcd__nearest points = nsvcd__near_points(posed.posed, posed.pair.fixed);
    if (nsvcd__goes_on_beside(p, item->moving_triangle, item->fixed_triangle, &points,
                              nsvcd__d3_widen(item->normal)))
      continue;
    const size_t count = nsvcd__contacts_of_side(query, item, &posed, &points, same, found);
    for (size_t n = 0; n < count && written < most; n++) contacts[written++] = found[n];
    for (uint32_t n = 0; n < list->count; n++) {
      nsvcd__near_pair *other = &list->items[n];
      if (nsvcd__f3_dot(other->normal, item->normal) >= NSVCD__SAME_SIDE)
        other->is_resolved = 1;
    }
    sides++;
  }
  return written;
}
#endif  // NSVCD_NO_PROOF

static nsvcd_result nsvcd__run_contacts(nsvcd__isa isa, const nsvcd_question *question,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_contact *contacts, size_t most, size_t *count,
                                        int *is_partial) {
  if (!question || !count || (most > 0 && !contacts)) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result result = nsvcd__sweep_check(question, workspace, workspace_size);
  if (result) return result;
  if (question->a.count > 1 || question->b.count > 1) return NSVCD_ERROR_POSES;
  if (question->ask != NSVCD_ASK_HIT) return NSVCD_ERROR_ASK;
  if (question->slop > 0) return NSVCD_ERROR_SLOP;
  if (!(question->clearance > 0)) return NSVCD_ERROR_CLEARANCE;
#ifndef NSVCD_NO_PROOF
  nsvcd__query *query = nsvcd__query_open(isa, question, workspace);
  const int is_whole = nsvcd__list_all_near(query, nsvcd__proof_begin(query));
  *count = nsvcd__write_contacts(query, contacts, most);
  for (size_t n = 0; n < *count && query->task.swapped; n++) nsvcd__swap_contact(&contacts[n]);
  if (is_partial) *is_partial = !is_whole;
#else
  (void)isa;
  (void)is_partial;
#endif
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_contacts(const nsvcd_question *question, void *workspace,
                                     size_t workspace_size, nsvcd_contact *contacts,
                                     size_t most, size_t *count, int *is_partial) {
  return nsvcd__run_contacts(nsvcd__isa_at_hand(), question, workspace, workspace_size,
                             contacts, most, count, is_partial);
}
