// In: bodies at rest, and a normal. Out: the triangle pairs that are near, and up to four contact
// points that span the largest area.
#pragma once
#include "../task/task.h"
#include "manifold.h"

#ifndef NSVCD_NO_PROOF
// Prepares a manifold of contacts with about this normal, unit, of bodies that move like this.
static void nsvcd__manifold_begin(nsvcd__manifold *m, nsvcd__d3 n, const nsvcd__twist *twist,
                                  double tolerance, double same) {
  const int flattest = fabs(n.x) < fabs(n.y) ? 0 : 1;
  const nsvcd__d3 aside = nsvcd__d3_of(flattest == 0, flattest == 1, 0);
  const nsvcd__d3 u = nsvcd__d3_unit(nsvcd__d3_cross(n, aside), nsvcd__d3_of(1, 0, 0));
  memset(m, 0, sizeof *m);
  m->normal = n;
  m->twist = *twist;
  m->tolerance = tolerance;
  m->same = same;
  // An eighth of a turn each: the sum of a direction and of that a quarter on, made unit.
  nsvcd__d3 along = u;
  for (int k = 0; k < NSVCD__AROUND; k++) {
    m->along[k] = along;
    m->farthest[k] = -HUGE_VAL;
    along = nsvcd__d3_scale(nsvcd__d3_add(along, nsvcd__d3_cross(n, along)), sqrt(0.5));
  }
  for (int k = NSVCD__AROUND; k < NSVCD__SUPPORTS; k++) m->farthest[k] = HUGE_VAL;
}

// If what has been found spans little for its length, prepares the two directions across it, for
// what is between the eight. area: twice what is spanned. Returns 0 if it is not so slim.
static int nsvcd__seek_across(nsvcd__manifold *m, double area) {
  nsvcd__d3 longest = {0, 0, 0};
  for (int k = 0; k < NSVCD__AROUND; k++) {
    for (int n = 0; n < k && m->farthest[k] > -HUGE_VAL && m->farthest[n] > -HUGE_VAL; n++) {
      const nsvcd__d3 offset = nsvcd__d3_sub(m->supports[k].point, m->supports[n].point);
      if (nsvcd__d3_dot(offset, offset) > nsvcd__d3_dot(longest, longest)) longest = offset;
    }
  }
  const double square = nsvcd__d3_dot(longest, longest);
  if (!(square > m->same * m->same) || area > NSVCD__SLIM * square) return 0;
  const nsvcd__d3 across = nsvcd__d3_unit(nsvcd__d3_cross(m->normal, longest), m->along[0]);
  for (int k = NSVCD__AROUND; k < NSVCD__SUPPORTS; k++) {
    m->along[k] = nsvcd__d3_scale(across, k == NSVCD__AROUND ? 1 : -1);
    m->farthest[k] = -HUGE_VAL;
    for (int n = 0; n < NSVCD__AROUND; n++) {
      const double along_it = nsvcd__d3_dot(m->along[k], m->supports[n].point);
      if (!(m->farthest[n] > -HUGE_VAL) || !(along_it > m->farthest[k])) continue;
      m->farthest[k] = along_it;
      m->supports[k] = m->supports[n];
      m->numbers[k] = m->numbers[n];
    }
  }
  return 1;
}

// Twice the area that four points span, seen along the normal.
static double nsvcd__spanned(const nsvcd__manifold *m, const int *of) {
  double most = 0;
  for (int k = 0; k < 3; k++) {
    const nsvcd__d3 a = m->supports[of[0]].point;
    const nsvcd__d3 b = m->supports[of[1 + k]].point;
    const nsvcd__d3 c = m->supports[of[1 + (k + 1) % 3]].point;
    const nsvcd__d3 d = m->supports[of[1 + (k + 2) % 3]].point;
    const nsvcd__d3 both = nsvcd__d3_cross(nsvcd__d3_sub(b, a), nsvcd__d3_sub(d, c));
    most = nsvcd__max(most, fabs(nsvcd__d3_dot(both, m->normal)));
  }
  return most;
}

// Chooses the contacts: which supports, and twice the area that they span. Returns how many.
static NSVCD__NOINLINE int nsvcd__choose_four(const nsvcd__manifold *m, int *chosen,
                                              double *area) {
  int kept[NSVCD__SUPPORTS];
  int count = 0;
  // Each point once, in the order of their numbers.
  for (int k = 0; k < NSVCD__SUPPORTS; k++) {
    int at = count;
    int is_new = m->farthest[k] > -HUGE_VAL && m->farthest[k] < HUGE_VAL;
    for (int n = 0; n < count; n++) {
      const nsvcd__d3 other = m->supports[kept[n]].point;
      is_new &= nsvcd__d3_distance2(m->supports[k].point, other) > m->same * m->same;
    }
    if (!is_new) continue;
    for (; at > 0 && m->numbers[k] < m->numbers[kept[at - 1]]; at--) kept[at] = kept[at - 1];
    kept[at] = k;
    count++;
  }
  memcpy(chosen, kept, sizeof(int) * (size_t)(count < 4 ? count : 4));
  *area = 0;
  for (int n = count; n < 4 && count > 0; n++) kept[n] = kept[count - 1];
  if (count > 0 && count <= 4) *area = nsvcd__spanned(m, kept);
  if (count <= 4) return count;
  for (uint32_t all = 0; all < 1u << count; all++) {
    int four[4];
    int size = 0;
    if (nsvcd__bit_count(all) != 4) continue;
    for (uint32_t left = all; left; left &= left - 1)
      four[size++] = kept[nsvcd__low_bit(left)];
    const double spanned = nsvcd__spanned(m, four);
    if (!(spanned > 1.001 * *area)) continue;
    *area = spanned;
    memcpy(chosen, four, 4 * sizeof *chosen);
  }
  return 4;
}

// Lists the triangle pairs of bodies at rest that come within the goal's clearance. There is one
// segment: so the memory for the chords of the others is free. Returns 0 if some may be missing.
static int nsvcd__list_all_near(nsvcd__query *query, nsvcd__goal goal) {
  nsvcd__solver *w = query->solver;
  nsvcd__search *q = &query->broad_phase;
  nsvcd__near_list *list = &w->p.near_list;
  nsvcd__chords *free_chords = q->members + 2;  // the second is that of spare boxes
  list->items = (nsvcd__near_pair *)(void *)free_chords;
  list->room = (uint32_t)((q->most_segments - 2) * sizeof *free_chords / sizeof *list->items);
  list->count = list->is_full = 0;
  goal.collects = NSVCD__LISTING;
  const nsvcd__search_result result = nsvcd__search_anew(w, q, goal);
  return !result.ran_out && !list->is_full;
}

// Chooses up to four contacts with about a normal from the list: which supports, and twice the area
// that they span. Only triangle pairs are asked whose directions are no farther from it than a
// cosine; below -1: all. Returns how many.
static int nsvcd__supports_of(nsvcd__proof *p, nsvcd__d3 normal, const nsvcd__twist *twist,
                              double least, double same, int *chosen, double *area) {
  nsvcd__manifold *m = &p->of.kept.manifold;
  const nsvcd__dtransform at = nsvcd__dtransform_at(nsvcd__arc_at(&p->arcs, 0), 0);
  nsvcd__posed_pair posed;
  int count = 0;
  nsvcd__manifold_begin(m, normal, twist, p->goal.clearance, same);
  for (int across = 0; across < 2; across++) {
    if (across && !nsvcd__seek_across(m, *area)) break;
    for (uint32_t n = 0; n < p->near_list.count; n++) {
      const nsvcd__near_pair *item = &p->near_list.items[n];
      if (nsvcd__d3_dot(nsvcd__d3_widen(item->normal), normal) < least) continue;
      nsvcd__posed_pair_of(p, &at, item, &posed);
      nsvcd__collect_supports(p, m, &posed.pair, posed.posed);
    }
    count = nsvcd__choose_four(m, chosen, area);
  }
  return count;
}
#endif  // NSVCD_NO_PROOF
