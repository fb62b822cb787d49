// In: how large a query's bodies and motions are. Out: the memory of its search, laid out: the
// segments of a motion, spheres on chords in them, and tiles of groups.
#pragma once
#include "../ground/memory.h"
#include "../body/traversal.h"
#include "segments.h"

// of a motion that turns by no more than NSVCD__SEGMENT_TURN in each
#define NSVCD__SEGMENTS 16
// at most: enough for 1280 degrees; what turns more is cut into intervals (motion/choice)
#define NSVCD__MAX_SEGMENTS 64

// 16 spheres on chords start + tau travel; their radii plus deviation, and -1 / |travel|^2.
typedef struct nsvcd__chords {
  nsvcd__row start[3], travel[3];
  nsvcd__row inverse, radius;
} nsvcd__chords;

typedef struct nsvcd__boxes {
  nsvcd__row low[3], high[3];
} nsvcd__boxes;

// Groups that are searched together. Slots without a group have the radius NSVCD__NOWHERE.
typedef struct nsvcd__tile {
  size_t count;
  uint16_t groups[NSVCD__TILE_SLOTS];
  nsvcd__spheres spheres;  // the body's own if it has a single tile, else collected
  float *collected;        // (4, NSVCD__TILE_SLOTS), or NULL
} nsvcd__tile;

// What a query needs memory for.
typedef struct nsvcd__needs {
  size_t moving_groups, fixed_groups;  // of a tile
  int large;                           // a body has more than these
  size_t segments;                     // 16, 32, 48 or 64
  size_t candidates;                   // of the network
  int proof;
} nsvcd__needs;

// The broad phase of a query: `q` in these rooms.
typedef struct nsvcd__search {
  const nsvcd_body *moving, *fixed;
  // the segments, S of them, and how many there is memory for
  size_t segments, most_segments;
  float scale;              // of the moving body
  uint32_t *begin;          // (S + 1) ticks at which they begin, and the last one ends
  float *time;              // (S + 1) the same as times
  float *turn;              // (S + 1) angle turned from t = 0 until then, radians
  nsvcd__segments *blocks;  // (S / 16 rounded up)
  nsvcd__chords *group;     // (S / 16 rounded up) a moving group's
  nsvcd__chords *members;   // (S) its 16 members', per segment
  nsvcd__cut *cut;          // in the same memory: segments are cut before any search
  uint64_t near_segments;   // in which the bodies' spheres meet
  // of large bodies, through the groups that come near
  nsvcd__traversal moving_traversal, fixed_traversal;
  nsvcd__box near_box;  // about the path of the moving tile
  // the groups that are searched now; what follows are indices into these
  nsvcd__tile moving_tile, fixed_tile;
  // (moving groups, fixed groups) segments in which they meet: see nsvcd__nearby
  uint64_t *nearby;
  size_t nearby_stride;
  uint64_t wanted;  // segments to search: some of them where contacts are sought in order
  // moving groups that are near any, in the order of the search; how many, and the current one
  uint16_t order[NSVCD__TILE_SLOTS];
  size_t steps, step;
  uint32_t waiting;  // fixed groups that it has yet to be searched against
  size_t at;         // which of them is next
  uint64_t ready;    // segments for which members[] is filled
  float extent;      // of these members, from the body's origin
#ifndef NSVCD_NO_NETWORK
  struct nsvcd__plane_cache *cache;  // search/planes
  uint16_t *met;                     // (GROUP, S) lanes of a group that meet each of another
  int balls_met;                     // 0: no patches' balls meet, which proves free
#endif
} nsvcd__search;

// Arrays of 16 lanes begin on a cache line if there are vectors, for vectors that cross lines are
// slower. That skips so many bytes at most, all of which are counted where base is NULL.
#define NSVCD__PASSED_OVER (NSVCD__SLICE > 1 ? 64 - NSVCD_ALIGNMENT : 0)

// Lays a search out in base, or, where that is NULL, only counts.
static void nsvcd__search_layout(const nsvcd__needs *needs, char *base, uint64_t *used,
                                 nsvcd__search *q) {
  const size_t s = needs->segments;
  const size_t blocks = s / NSVCD__LANES;
  const size_t members = s * sizeof(nsvcd__chords);
  const size_t shared = members > sizeof(nsvcd__cut) ? members : sizeof(nsvcd__cut);
  const size_t collected = needs->large ? 4 * NSVCD__TILE_SLOTS : 0;
  const size_t pairs = needs->moving_groups * needs->fixed_groups;
  q->most_segments = s;
  q->begin = NSVCD__TAKE_ROWS(uint32_t, s + 1, base, used);
  q->time = NSVCD__TAKE_ROWS(float, s + 1, base, used);
  q->turn = NSVCD__TAKE_ROWS(float, s + 1, base, used);
  if (NSVCD__PASSED_OVER > 0)
    *used += base ? (0 - (uintptr_t)(base + *used)) & 63 : NSVCD__PASSED_OVER;
  q->blocks = NSVCD__TAKE_ROWS(nsvcd__segments, blocks, base, used);
  q->group = NSVCD__TAKE_ROWS(nsvcd__chords, blocks, base, used);
  q->members = (nsvcd__chords *)nsvcd__take(base, used, 1, shared);
  q->cut = (nsvcd__cut *)(void *)q->members;
  q->nearby_stride = needs->fixed_groups;
  q->nearby = NSVCD__TAKE_ROWS(uint64_t, pairs, base, used);
  q->moving_tile.collected = NSVCD__TAKE_ROWS(float, collected, base, used);
  q->fixed_tile.collected = NSVCD__TAKE_ROWS(float, collected, base, used);
}

// Scratch chords, and boxes: members[] before a group is posed.
static nsvcd__chords *nsvcd__spare_chords(const nsvcd__search *q) {
  return &q->members[0];
}
static nsvcd__boxes *nsvcd__spare_boxes(const nsvcd__search *q) {
  return (nsvcd__boxes *)(void *)&q->members[1];
}

// The segments in which group g of the moving tile meets each one of the fixed tile.
static uint64_t *nsvcd__nearby(const nsvcd__search *q, size_t g) {
  return q->nearby + g * q->nearby_stride;
}
