// In: the farthest contact points along directions. Out: the directions, and the best four points.
#pragma once
#include "../entry/processor.h"

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
#endif  // NSVCD_NO_PROOF
