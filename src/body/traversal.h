// In: a body and a filter of spheres. Out: the groups whose spheres pass.
#pragma once
#include "body.h"

// Which of 16 spheres pass? A bit for each.
typedef uint32_t nsvcd__filter(const void *what, nsvcd__spheres spheres);

// Visits, in order, the groups that pass a filter, as do all spheres over them.
typedef struct nsvcd__traversal {
  const nsvcd_body *body;
  nsvcd__filter *filter;
  const void *what;
  size_t levels, level;
  // on each level: the first of the spheres at hand, and bits of those still to be visited
  uint32_t first[NSVCD__LEVELS], left[NSVCD__LEVELS];
} nsvcd__traversal;

// Filters 16 spheres of a level.
static uint32_t nsvcd__traversal_filter(const nsvcd__traversal *t, size_t level,
                                        size_t first) {
  const nsvcd__level at = nsvcd__level_of(t->body->padded, level);
  const nsvcd__spheres all = nsvcd__level_spheres(t->body, at);
  return t->filter(t->what, nsvcd__spheres_from(all, first));
}

static void nsvcd__traversal_begin(nsvcd__traversal *t, const nsvcd_body *body,
                                   nsvcd__filter *filter, const void *what) {
  t->body = body;
  t->filter = filter;
  t->what = what;
  t->levels = nsvcd__level_count(body->padded);
  t->level = t->levels - 1;
  t->first[t->level] = 0;
  uint32_t left = 0;
  const size_t slots = nsvcd__level_of(body->padded, t->level).slots;
  for (size_t first = 0; first < slots; first += NSVCD__GROUP)
    left |= nsvcd__traversal_filter(t, t->level, first) << first;
  t->left[t->level] = left;
}

// Goes to the next group. 0 if there is none.
static int nsvcd__traversal_next(nsvcd__traversal *t, size_t *group) {
  for (;;) {
    while (!t->left[t->level]) {
      if (t->level + 1 == t->levels) return 0;
      t->level++;
    }
    uint32_t *left = &t->left[t->level];
    const size_t found = t->first[t->level] + nsvcd__low_bit(*left);
    *left &= *left - 1;
    if (t->level == 0) {
      *group = found;
      return 1;
    }
    t->level--;
    t->first[t->level] = (uint32_t)(NSVCD__GROUP * found);
    t->left[t->level] = nsvcd__traversal_filter(t, t->level, NSVCD__GROUP * found);
  }
}
