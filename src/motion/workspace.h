// In: how large a query's bodies and motions are. Out: the memory of its search, laid out: the
// segments of a motion, spheres on chords in them, and tiles of groups.
#pragma once
#include "../ground/memory.h"
#include "../body/traversal.h"
#include "motion.h"

// ---- lanes

// The vector in lane l alone.
static inline nsvcd__f3 nsvcd__lane_of(nsvcd__row *p, size_t l) {
  return nsvcd__f3_get(p[0] + l, NSVCD__LANES);
}
static inline void nsvcd__lane_set(nsvcd__f3 a, nsvcd__row *p, size_t l) {
  nsvcd__f3_put(a, p[0] + l, NSVCD__LANES);
}
// The matrix in lane l of p (9, LANES), row-major.
static inline nsvcd__mat3 nsvcd__mat3_lane(nsvcd__row *p, size_t l) {
  const nsvcd__mat3 out = {nsvcd__lane_of(p, l), nsvcd__lane_of(p + 3, l),
                           nsvcd__lane_of(p + 6, l)};
  return out;
}

// ---- segments, and what is searched

// of a motion that turns by no more than NSVCD__SEGMENT_TURN in each
#define NSVCD__SEGMENTS 16
// at most: enough for 1280 degrees; what turns more is cut into intervals (motion/choice)
#define NSVCD__MAX_SEGMENTS 64

// Times the lengths that enter a difference of positions: about 15 float operations of 6e-8 each,
// doubled.
#define NSVCD__ROUNDING 2e-6f

// 16 segments: the pose at the start, its change until the end, and bounds of the deviation.
typedef struct nsvcd__segments {
  nsvcd__row rotation[9], position[3];
  nsvcd__row turned[9], moved[3];
  nsvcd__row margin, bend;
  // For the proof, along directions: see nsvcd__deviation_of.
  nsvcd__row rounding, axis[3], heading[3];
  nsvcd__row bend_along_axis;
  nsvcd__row origin_bend, origin_along_axis;
  nsvcd__row origin_off_heading;
} nsvcd__segments;

#define NSVCD__ENDS (NSVCD__LANES + 1)  // of 16 segments, one after the other

// Poses of both bodies at the ends of segments, or at other ticks, in the world.
typedef struct nsvcd__keyframes {
  float moving[4 * NSVCD__ENDS];  // (4, ENDS) quaternions, as the next two
  float fixed[4 * NSVCD__ENDS];
  float seen[4 * NSVCD__ENDS];    // the moving body's, in the fixed body's frame
  float offset[3 * NSVCD__ENDS];  // (3, ENDS) see nsvcd__v_poses
} nsvcd__keyframes;

// The greatest values so far of 16 segments, while their keyframes are visited.
typedef struct nsvcd__bends {
  nsvcd__row turn;  // the sum of the arcs' angles
  // arcs off their chords: per metre from the moving origin, along the axis too, and that origin
  nsvcd__row arc_bend, arc_along_axis, arc_origin;
  // keyframes off the segment's chord, squared: the rotation and the position, and both along the
  // axis; the position across the heading
  nsvcd__row off, origin_off, along_axis;
  nsvcd__row origin_along_axis, origin_off_heading;
} nsvcd__bends;

typedef struct nsvcd__cut {
  nsvcd__keyframes here, last, end;  // read now, the ones before, and at the segments' ends
  nsvcd__bends most;
} nsvcd__cut;

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

#ifndef NSVCD_NO_NETWORK
// The ranges of 16 patches along a plane's normal.
typedef struct nsvcd__ranges {
  nsvcd__row low, high;
} nsvcd__ranges;

#define NSVCD__PLANES 2  // that are remembered

// Planes that separated others, and the ranges of two groups along them: of the moving one in one
// segment.
typedef struct nsvcd__plane_cache {
  nsvcd__f3 planes[NSVCD__PLANES];  // normals: the last of those found
  uint32_t found, best;             // how many; which of them separated last
  float inflate;                    // patches, by so much of their radii
  int balls_only;                   // no planes are tried
  nsvcd__ranges moving[NSVCD__PLANES], resting[NSVCD__PLANES];
  uint32_t moving_known, resting_known;  // bits of planes whose ranges are filled in
  float deviation;                       // of the moving group's points in the segment
} nsvcd__plane_cache;

// A contact interval: the balls of patches `moving` and `fixed` overlap from t_enter to t_exit,
// with the deviation added.
typedef struct nsvcd__candidate {
  uint16_t moving, fixed;
  float t_enter, t_exit;
  float t_least;  // when they are nearest
  float depth;    // rank, 1 - least distance / (r1 + r2): the deepest go on to the network
  // what the network says: a logit, or NSVCD__NO_SCORE; and a distance, in tenths of r1 + r2
  float score, apart;
} nsvcd__candidate;

// The candidates kept so far: a heap with the shallowest at its root.
typedef struct nsvcd__candidates {
  nsvcd__candidate *items;  // (limit), the caller's
  size_t limit, count;
  size_t total;  // intervals found, kept or not
} nsvcd__candidates;
#endif

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
  nsvcd__plane_cache *cache;
  uint16_t *met;  // (GROUP, S) lanes of a group that meet each of another
  int balls_met;  // 0: no patches' balls meet, which proves free
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

static int nsvcd__is_large(const nsvcd_body *body) {
  return nsvcd__body_groups(body) > NSVCD__TILE;
}
static int nsvcd__is_tiled(const nsvcd_body *a, const nsvcd_body *b) {
  return nsvcd__is_large(a) || nsvcd__is_large(b);
}
