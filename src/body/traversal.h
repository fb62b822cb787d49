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
static uint32_t nsvcd__traversal_filter(const nsvcd__traversal *traversal, size_t level,
                                        size_t first) {
  const nsvcd__level at = nsvcd__level_of(traversal->body->padded, level);
  const nsvcd__spheres all = nsvcd__level_spheres(traversal->body, at);
  return traversal->filter(traversal->what, nsvcd__spheres_from(all, first));
}

static void nsvcd__traversal_begin(nsvcd__traversal *traversal, const nsvcd_body *body,
                                   nsvcd__filter *filter, const void *what) {
  traversal->body = body;
  traversal->filter = filter;
  traversal->what = what;
  traversal->levels = nsvcd__level_count(body->padded);
  traversal->level = traversal->levels - 1;
  traversal->first[traversal->level] = 0;
  uint32_t left = 0;
  const size_t slots = nsvcd__level_of(body->padded, traversal->level).slots;
  for (size_t first = 0; first < slots; first += NSVCD__GROUP)
    left |= nsvcd__traversal_filter(traversal, traversal->level, first) << first;
  traversal->left[traversal->level] = left;
}

// Goes to the next group. 0 if there is none.
static int nsvcd__traversal_next(nsvcd__traversal *traversal, size_t *group) {
  for (;;) {
    while (!traversal->left[traversal->level]) {
      if (traversal->level + 1 == traversal->levels) return 0;
      traversal->level++;
    }
    uint32_t *left = &traversal->left[traversal->level];
    const size_t found = traversal->first[traversal->level] + nsvcd__low_bit(*left);
    *left &= *left - 1;
    if (traversal->level == 0) {
      *group = found;
      return 1;
    }
    traversal->level--;
    traversal->first[traversal->level] = (uint32_t)(NSVCD__GROUP * found);
    traversal->left[traversal->level] =
        nsvcd__traversal_filter(traversal, traversal->level, NSVCD__GROUP * found);
  }
}
