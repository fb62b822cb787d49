// Ears between the rooms of the proof: what these call separated, for tests/test_proof.c to refute.
// A room uses only rooms above it. So once a room is included, macros over its functions hear what
// the rooms below are told, and by which plane it is so: a macro is not expanded in itself. Include
// before all other rooms.
#ifndef PROOF_EARS_H
#define PROOF_EARS_H

#include "../src/triangles/motion_bounds.h"

#include <stdlib.h>

#define CERTIFICATES 300000  // kept of one query

// What separates two patches: slabs of their groups, their own, a plane sought between their hulls,
// or the one that held last.
enum {
  HEARD_GROUPS,
  HEARD_SLABS,
  HEARD_HULLS,
  HEARD_AGAIN,
  // two triangles: their block's boxes or the plane that separated a pair last; their own boxes or
  // planes; that last plane, in a row and in all of two patches; one of the pair
  HEARD_BLOCKS,
  HEARD_ROWS,
  HEARD_LAST,
  HEARD_PATCHES,
  HEARD_PAIRS,
  HEARD_RESOLVED,  // planes of parts of the time: not told which
  HEARD_KINDS
};

// Patches i and j, or their entries a and b, are separated from start to end by a plane with one of
// these normals, of any length and either sign, in the fixed body's frame; in blocks and rows, for
// their boxes, perhaps by one across an axis.
typedef struct proof_record {
  int kind;
  size_t i, j, a, b;
  double start, end;
  nsvcd__d3 normals[2];  // the second one: 0, but of slabs
} proof_record;

static struct {
  double start, end;  // of the interval that was asked for last
  proof_record *items;
  size_t count, left_out;
  unsigned forgetful;  // > 0: what is only remembered is forgotten one time in so many
  unsigned forgotten;  // how often it was
} heard;

static proof_record *proof_heard(int kind, size_t i, size_t j, size_t a, size_t b,
                                 nsvcd__d3 normal) {
  static proof_record spare;
  if (!heard.items) heard.items = (proof_record *)malloc(CERTIFICATES * sizeof *heard.items);
  if (!heard.items) exit(1);
  const int has_room = heard.count < CERTIFICATES;
  proof_record *r = has_room ? &heard.items[heard.count++] : &spare;
  const proof_record out = {kind, i, j, a, b, heard.start, heard.end, {normal, {0, 0, 0}}};
  heard.left_out += !has_room;
  *r = out;
  return r;
}

// Where all memory may be lost: between patch pairs, and between parts of one.
static void proof_may_lose(nsvcd__solver *w) {
  static uint32_t random = 1;
  if (heard.forgetful == 0) return;
  random = random * 1664525u + 1013904223u;
  if ((random >> 8) % heard.forgetful) return;
  heard.forgotten++;
  w->p.arcs.arc.ticks = 0;
  w->p.separating = nsvcd__d3_of(0, 0, 0);
  w->p.shared = w->blocks.window = 0;
  w->blocks.has_block = 0;
  memset(&w->memo, 0, sizeof w->memo);
  memset(w->p.arcs.poses, 0, sizeof w->p.arcs.poses);
}

// The time of a tick, t in [0,1].
static double proof_time(const nsvcd__proof *p, double tick) {
  const nsvcd__motion *m = p->arcs.motion;
  return m->begin + m->duration * tick / (double)m->ticks;
}
static double proof_time_in_arc(const nsvcd__proof *p, double u) {
  return proof_time(p, (double)p->arcs.arc.first + u * (double)p->arcs.arc.ticks);
}
// A proof is the first of its solver.
#define proof_solver(p) ((nsvcd__solver *)(p))
#define nsvcd__segment_interval(w, q, s)                                                  \
  (heard.start = proof_time(&(w)->p, (double)(q)->begin[s]),                              \
   heard.end = proof_time(&(w)->p, fmin((double)(q)->begin[(s) + 1u], (w)->p.known.end)), \
   nsvcd__segment_interval(w, q, s))
#define nsvcd__interval_of_arc(p, first, u0, u1)                                 \
  (proof_may_lose(proof_solver(p)), (void)nsvcd__arc_at(&(p)->arcs, first),      \
   heard.start = proof_time_in_arc(p, u0), heard.end = proof_time_in_arc(p, u1), \
   nsvcd__interval_of_arc(p, first, u0, u1))
#include "../src/separate/slabs.h"
#include "../src/separate/hulls.h"
#include "../src/separate/containment.h"
#include "../src/separate/witnesses.h"

// Slabs separate by the normal of the fixed one, or by the mean of the moving one's at both ends.
static void proof_heard_slabs(int kind, const nsvcd__interval *over, size_t i, size_t j,
                              nsvcd__f3 moving, nsvcd__f3 fixed) {
  const nsvcd__f3 start = nsvcd__mat3_apply(&over->start.rotation, moving);
  const nsvcd__f3 end = nsvcd__mat3_apply(&over->end.rotation, moving);
  proof_heard(kind, i, j, 0, 0, nsvcd__d3_widen(fixed))->normals[1] =
      nsvcd__d3_widen(nsvcd__f3_add(start, end));
}
static uint32_t proof_slabs_meet(const nsvcd__proof *p, const nsvcd__interval *over,
                                 const nsvcd__search *q, size_t g, size_t j, size_t s,
                                 uint32_t met) {
  const uint32_t left = nsvcd__slabs_meet(p, over, q, g, j, s, met);
  const nsvcd__slab fixed = nsvcd__slab_at(p->fixed.slabs, p->fixed.body->padded, j);
  for (uint32_t apart = met & ~left; apart; apart &= apart - 1) {
    const size_t i = NSVCD__GROUP * g + nsvcd__low_bit(apart);
    if (i >= p->moving.body->patches) continue;
    const nsvcd__slab moving = nsvcd__slab_at(p->moving.slabs, p->moving.body->padded, i);
    proof_heard_slabs(HEARD_SLABS, over, i, j, moving.normal, fixed.normal);
  }
  return left;
}
// All members of two groups are separated in a segment.
static void proof_heard_groups(nsvcd__solver *w, const nsvcd__search *q, size_t g, size_t h,
                               size_t s) {
  const nsvcd_body *moving = w->p.moving.body;
  const nsvcd_body *fixed = w->p.fixed.body;
  const nsvcd__slab own =
      nsvcd__slab_at(w->p.moving.group_slabs, nsvcd__group_slots(moving->padded), g);
  const nsvcd__slab other =
      nsvcd__slab_at(w->p.fixed.group_slabs, nsvcd__group_slots(fixed->padded), h);
  const nsvcd__interval *over = nsvcd__segment_interval(w, q, s);
  for (size_t k = 0; k < NSVCD__GROUP * NSVCD__GROUP; k++) {
    const size_t i = NSVCD__GROUP * g + k / NSVCD__GROUP;
    const size_t j = NSVCD__GROUP * h + k % NSVCD__GROUP;
    if (i < moving->patches && j < fixed->patches)
      proof_heard_slabs(HEARD_GROUPS, over, i, j, own.normal, other.normal);
  }
}
static void proof_separate_groups(nsvcd__solver *w, nsvcd__search *q) {
  const size_t next = q->order[q->step];
  const uint64_t *nearby = nsvcd__nearby(q, next);
  uint64_t before[NSVCD__TILE];
  uint32_t waiting = q->waiting;
  memcpy(before, nearby, q->fixed_tile.count * sizeof *before);
  nsvcd__separate_groups(&w->p, q);
  for (; waiting; waiting &= waiting - 1) {
    const size_t at = nsvcd__low_bit(waiting);
    for (size_t s = 0; s < q->segments; s++) {
      if ((before[at] & ~nearby[at]) >> s & 1)
        proof_heard_groups(w, q, q->moving_tile.groups[next], q->fixed_tile.groups[at], s);
    }
  }
}
// The same of one group of the moving body, and 16 groups or 16 patches of the fixed one.
static uint32_t proof_slabs_on_way(nsvcd__solver *w, nsvcd__way *way, nsvcd__spheres spheres,
                                   size_t level, size_t first, uint32_t met) {
  const nsvcd_body *moving = w->p.moving.body;
  const nsvcd_body *fixed = w->p.fixed.body;
  const size_t each = level ? NSVCD__GROUP : 1;  // patches
  const float *slabs = level ? w->p.fixed.group_slabs : w->p.fixed.slabs;
  const size_t stride = level ? nsvcd__group_slots(fixed->padded) : fixed->padded;
  const nsvcd__slab own =
      nsvcd__slab_at(w->p.moving.group_slabs, nsvcd__group_slots(moving->padded), 0);
  const uint32_t left = nsvcd__slabs_on_way(w, way, spheres, level, first, met);
  heard.start = proof_time(&w->p, way->start);
  heard.end = proof_time(&w->p, way->start + way->length);
  for (uint32_t apart = met & ~left; apart; apart &= apart - 1) {
    const size_t n = first + nsvcd__low_bit(apart);
    const nsvcd__slab other = nsvcd__slab_at(slabs, stride, n);
    for (size_t i = 0; i < moving->patches; i++) {
      for (size_t j = each * n; j < each * (n + 1) && j < fixed->patches; j++)
        proof_heard_slabs(HEARD_GROUPS, &w->intervals[way->segment], i, j, own.normal,
                          other.normal);
    }
  }
  return left;
}
#define nsvcd__slabs_on_way proof_slabs_on_way
#define nsvcd__slabs_meet proof_slabs_meet
#define nsvcd__separate_groups(p, q) proof_separate_groups(proof_solver(p), q)

static int proof_heard_hulls(int kind, const nsvcd__solver *w, size_t i, size_t j, int apart) {
  if (apart) proof_heard(kind, i, j, 0, 0, nsvcd__d3_widen(w->memo.held));
  return apart;
}
#define nsvcd__hulls_are_apart(p, i, j, over) \
  proof_heard_hulls(HEARD_HULLS, p, i, j, nsvcd__hulls_are_apart(p, i, j, over))
#define nsvcd__held_again(p, q, pair)                                                  \
  (proof_may_lose(p), proof_heard_hulls(HEARD_AGAIN, p, (pair)->moving, (pair)->fixed, \
                                        nsvcd__held_again(p, q, pair)))

// Lanes of the moving block, or lane l of it, and lanes of a fixed one, by a plane with the normal.
static void proof_heard_lanes(int kind, const nsvcd__solver *w, const nsvcd__block *fixed, size_t l,
                              uint32_t apart, nsvcd__d3 normal) {
  const nsvcd__block *moving = &w->blocks.moving;
  for (; apart; apart &= apart - 1)
    proof_heard(kind, moving->patch, fixed->patch, moving->first + l,
                fixed->first + nsvcd__low_bit(apart), normal);
}
static uint32_t proof_heard_blocks(const nsvcd__solver *w, const nsvcd__block *fixed,
                                   uint32_t left) {
  for (size_t l = 0; l < w->blocks.moving.count; l++) {
    const uint32_t apart = left >> l & 1 ? 0 : nsvcd__block_lanes(fixed);
    proof_heard_lanes(HEARD_BLOCKS, w, fixed, l, apart, w->p.separating);
  }
  return left;
}
static uint32_t proof_heard_last(const nsvcd__solver *w, const nsvcd__block *fixed, size_t l,
                                 uint32_t met, uint32_t left) {
  proof_heard_lanes(HEARD_LAST, w, fixed, l, met & ~left, w->p.separating);
  return left;
}
// By the first of the normals whose plane does, or none: by boxes.
static uint32_t proof_heard_row(nsvcd__solver *w, nsvcd__block *fixed, size_t l, float margin,
                                uint32_t left) {
  for (uint32_t apart = nsvcd__block_lanes(fixed) & ~left; apart; apart &= apart - 1) {
    const uint32_t one = apart & (~apart + 1);
    const size_t n = nsvcd__low_bit(one);
    const size_t s = n / NSVCD__SLICE * NSVCD__SLICE;
    float normals[3][NSVCD__LANES] = {{0}};
    size_t k = 0;
    while (k < NSVCD__NORMALS && nsvcd__left_by_normal(w, l, fixed, k, margin, one)) k++;
    if (k < NSVCD__NORMALS) nsvcd__v3_store(normals, s, nsvcd__normal_to_try(w, l, fixed, s, k));
    proof_heard_lanes(HEARD_ROWS, w, fixed, l, one, nsvcd__d3_widen(nsvcd__lane_of(normals, n)));
  }
  return left;
}
#define nsvcd__lanes_left_by_last(p, fixed, margin, lanes) \
  proof_heard_blocks(p, fixed, nsvcd__lanes_left_by_last(p, fixed, margin, lanes))
#define nsvcd__row_left(p, l, fixed, margin) \
  proof_heard_row(p, fixed, l, margin, nsvcd__row_left(p, l, fixed, margin))
#define nsvcd__left_by_normal(p, l, fixed, k, margin, met) \
  proof_heard_last(p, fixed, l, met, nsvcd__left_by_normal(p, l, fixed, k, margin, met))

// From u0 to u1 of the arc.
static void proof_heard_pair(int kind, const nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                             size_t a, size_t b, double u0, double u1) {
  proof_record *r = proof_heard(kind, pair->moving_patch, pair->fixed_patch, a, b, p->separating);
  r->start = proof_time_in_arc(p, u0);
  r->end = proof_time_in_arc(p, u1);
}
// Heard only of nsvcd__patches_apart, which asks for each triangle of the moving patch: after the
// last one, all of both patches are separated.
static int proof_heard_patches(const nsvcd__proof *p, const nsvcd__triangle_pair *pair, double u0,
                               double u1, int apart) {
  const uint32_t *moving = &p->moving.first_triangle[pair->moving_patch];
  const uint32_t *fixed = &p->fixed.first_triangle[pair->fixed_patch];
  for (size_t a = moving[0]; apart && pair->moving_entry + 1 == moving[1] && a < moving[1]; a++)
    for (size_t b = fixed[0]; b < fixed[1]; b++)
      proof_heard_pair(HEARD_PATCHES, p, pair, a, b, u0, u1);
  return apart;
}
// Asks of the plane that a pair's nearest points give in the middle of an interval for which part
// of that, a tenth shorter each time, it separates them.
static void proof_ask_plane(nsvcd__proof *p, const nsvcd__triangle_pair *pair, double u0,
                            double u1) {
  const nsvcd__d3 before = p->separating;
  const double middle = 0.5 * (u0 + u1);
  const nsvcd__nearest nearest = nsvcd__pair_nearest(&p->arcs, pair, middle);
  double half = 0.5 * (u1 - u0);
  if (!(nearest.square > 0)) return;
  (void)nsvcd__aim_plane(p, pair, middle, &nearest);
  while (half > 1e-3 * (u1 - u0) && !nsvcd__plane_separates(p, pair, middle - half, middle + half))
    half *= 0.9;
  if (half > 1e-3 * (u1 - u0))
    proof_heard_pair(HEARD_PAIRS, p, pair, pair->moving_entry, pair->fixed_entry, middle - half,
                     middle + half);
  p->separating = before;
}
static nsvcd__outcome proof_resolve_pair(nsvcd__proof *p, const nsvcd__triangle_pair *pair,
                                         double u0, double u1) {
  proof_ask_plane(p, pair, u0, u1);
  const nsvcd__outcome out = nsvcd__resolve_pair(p, pair, u0, u1);
  // where none has been unresolved yet, this one is not
  if (out == NSVCD__DONE && !(p->known.unresolved < NSVCD__NEVER))
    proof_heard_pair(HEARD_RESOLVED, p, pair, pair->moving_entry, pair->fixed_entry, u0,
                     fmin(u1, nsvcd__arc_limit(p)));
  return out;
}
#define nsvcd__plane_separates(p, pair, u0, u1) \
  proof_heard_patches(p, pair, u0, u1, nsvcd__plane_separates(p, pair, u0, u1))
#define nsvcd__resolve_pair proof_resolve_pair
#include "../src/separate/loop.h"

#endif
