// In: a body and a filter of spheres. Out: the groups whose spheres pass.
#pragma once
#include "body.h"

// Which of 16 spheres are of interest? Bits of lanes.
typedef uint32_t nsvcd__filter(const void *what, nsvcd__spheres spheres);

// Finds the groups whose spheres, and all spheres over them, pass a filter, in their order.
typedef struct nsvcd__walk {
  const nsvcd_body *body;
  nsvcd__filter *filter;
  const void *what;
  size_t levels, level;
  // on each level, the first of the spheres looked at
  uint32_t first[NSVCD__LEVELS];
  // and those of them that passed, and are still to be visited
  uint32_t left[NSVCD__LEVELS];
} nsvcd__walk;

// Which of 16 spheres of a level pass? Bits of lanes.
static uint32_t nsvcd__walk_look(const nsvcd__walk *walk, size_t level, size_t first) {
  const nsvcd__level at = nsvcd__level_of(walk->body->padded, level);
  const nsvcd__spheres all = nsvcd__level_spheres(walk->body, at);
  return walk->filter(walk->what, nsvcd__spheres_from(all, first));
}

static void nsvcd__walk_begin(nsvcd__walk *walk, const nsvcd_body *body, nsvcd__filter *filter,
                              const void *what) {
  walk->body = body;
  walk->filter = filter;
  walk->what = what;
  walk->levels = nsvcd__level_count(body->padded);
  walk->level = walk->levels - 1;
  walk->first[walk->level] = 0;
  uint32_t left = 0;
  const size_t slots = nsvcd__level_of(body->padded, walk->level).slots;
  for (size_t first = 0; first < slots; first += NSVCD__GROUP)
    left |= nsvcd__walk_look(walk, walk->level, first) << first;
  walk->left[walk->level] = left;
}

// The next group; 0 if there is none.
static int nsvcd__walk_next(nsvcd__walk *walk, size_t *group) {
  for (;;) {
    while (!walk->left[walk->level]) {
      if (walk->level + 1 == walk->levels) return 0;
      walk->level++;
    }
    uint32_t *left = &walk->left[walk->level];
    const size_t found = walk->first[walk->level] + nsvcd__low_bit(*left);
    *left &= *left - 1;
    if (walk->level == 0) {
      *group = found;
      return 1;
    }
    walk->level--;
    walk->first[walk->level] = (uint32_t)(NSVCD__GROUP * found);
    walk->left[walk->level] = nsvcd__walk_look(walk, walk->level, NSVCD__GROUP * found);
  }
}
