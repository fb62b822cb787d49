// In: N patches. Out: one relocatable, checksummed blob. Patches are stored in groups of 16
// neighbours, each with a sphere over its members. If there are many groups, there are levels of
// spheres above them, a tree for the broad phase. There are two kinds of bodies, which begin alike:
//
//   struct nsvcd_body    64 bytes
//   x, y, z, r   (4, P)  float: spheres of the patches, body frame, metres; P = N rounded up to 16;
//                        padding has r = NSVCD__NOWHERE
//   x, y, z, r   (4, G)  float: spheres of the groups; G = P / 16 rounded up to 16, padding as
//                        above. In a body of latents over the patches' spheres; in one of
//                        triangles over the surface in them, which may be much smaller
//   x, y, z, r   (4, H)  float: if there are more than 32 groups, spheres over 16 groups each;
//                        H as G
//   x, y, z, r   (4, I)  float: if these are more than 16, spheres over 16 of them each
//
// A body of latents, for the network, goes on with
//   x, y, z      (3, P)  float: area vectors, square metres, along the outward normal; padding is
//                        zero
//   x, y, z      (3, G), (3, H), (3, I)  float: if there are more than 32 groups, their sums over
//                        the members of the spheres above
//   extremes     (P / 16, 8, 3, 16)  int8: eight points of each patch of a group of 16, from its
//                        centre in steps of r / 127; padding is zero
//   latents      (N, NSVCD__LATENT)  int8, the same at any scale
// and a body of triangles, for the proof, with what body/geometry says. A body that has both is one
// of latents with one of triangles behind it, at `inner`. Patches have the same numbers in both;
// spheres differ. Each part is padded with zeros to a multiple of NSVCD_ALIGNMENT.
#pragma once
#include "../ground/valid.h"
#include "../interface/bodies.h"
#include "../ground/spheres.h"
#include "../ground/bits.h"
#include "../ground/slices.h"
#include "../encoder/model.h"

// 0: triangles are neither stored nor read
#ifdef NSVCD_NO_PROOF
#define NSVCD__PROOF 0
#else
#define NSVCD__PROOF 1
#endif
// members of a group, and of a sphere of a level
#define NSVCD__GROUP NSVCD__LANES
// Groups of a body that are searched at once; bodies with more have levels above them. (Tests
// define fewer, so that small bodies have several tiles.)
#ifndef NSVCD__TILE
#define NSVCD__TILE 32
#endif
#define NSVCD__TILE_SLOTS 32
#define NSVCD__LEVELS 3  // at most
// metres: no radius or distance of coordinates in range exceeds it
#define NSVCD__MAX_LENGTH 1.6e7f
#define NSVCD__BODY_MAGIC 0x4256534eu  // "NSVB", or "BVSN": the mark of the byte order
#define NSVCD__OTHER_MAGIC 0x4e535642u
#define NSVCD__BODY_VERSION 9u

struct nsvcd_body {
  uint32_t magic, version;
  // of everything that follows
  uint64_t checksum;
  // bytes of the whole blob
  uint32_t size;
  // of the weights that made the latents; 0: a body of triangles
  uint32_t weights_id;
  uint32_t patches;  // N
  uint32_t padded;   // P
  // a sphere over all
  float centre[3], radius;
  // max |p_i| + r_i: nothing is farther from the body's origin
  float extent;
  // 1: nothing can be inside
  uint32_t open;
  // of the mesh; 0: none are stored
  uint32_t triangles;
  // bytes from here to the body of triangles; 0: there is none
  uint32_t inner;
};

static size_t nsvcd__group_slots(size_t padded) {
  return nsvcd__round_up(padded / NSVCD__GROUP, NSVCD__GROUP);
}
// How many of `members` are in the group that begins with number `first`.
static size_t nsvcd__group_members(size_t members, size_t first) {
  const size_t left = first < members ? members - first : 0;
  return left < NSVCD__GROUP ? left : NSVCD__GROUP;
}

// A level of spheres. Level 0 are the groups; a sphere of any other is over 16 of the level below.
typedef struct nsvcd__level {
  size_t count;  // spheres
  // the same, rounded up to 16
  size_t slots;
  // of its floats, from the body's first: x (slots), y, z, r
  size_t first;
} nsvcd__level;

static nsvcd__level nsvcd__level_of(size_t padded, size_t level) {
  nsvcd__level out = {padded / NSVCD__GROUP, nsvcd__group_slots(padded), 4 * padded};
  for (; level > 0; level--) {
    out.first += 4 * out.slots;
    out.count = nsvcd__round_up(out.count, NSVCD__GROUP) / NSVCD__GROUP;
    out.slots = nsvcd__round_up(out.count, NSVCD__GROUP);
  }
  return out;
}

// How many levels there are: none above the groups if these are searched at once.
static size_t nsvcd__level_count(size_t padded) {
  size_t levels = 1;
  if (padded / NSVCD__GROUP <= NSVCD__TILE) return 1;
  while (nsvcd__level_of(padded, levels - 1).count > NSVCD__GROUP) levels++;
  return levels;
}

static size_t nsvcd__body_groups(const nsvcd_body *body) {
  return body->padded / NSVCD__GROUP;
}
static const float *nsvcd__body_floats(const nsvcd_body *body, size_t first) {
  return (const float *)(body + 1) + first;
}
static const float *nsvcd__body_r(const nsvcd_body *body) {
  return nsvcd__body_floats(body, 3 * body->padded);
}
static nsvcd__spheres nsvcd__body_patches(const nsvcd_body *body) {
  return nsvcd__spheres_of(nsvcd__body_floats(body, 0), body->padded);
}
static nsvcd__spheres nsvcd__level_spheres(const nsvcd_body *body, nsvcd__level level) {
  return nsvcd__spheres_of(nsvcd__body_floats(body, level.first), level.slots);
}
static nsvcd__spheres nsvcd__groups_of(const nsvcd_body *body) {
  return nsvcd__level_spheres(body, nsvcd__level_of(body->padded, 0));
}
static nsvcd__sphere nsvcd__body_sphere(const nsvcd_body *body) {
  const nsvcd__sphere out = {nsvcd__f3_load(body->centre), body->radius};
  return out;
}

// The address, writable, in a body that is being written.
static void *nsvcd__writable(nsvcd_body *body, const void *address) {
  return (char *)body + ((const char *)address - (const char *)body);
}

// Spheres with their padding: of the patches and all levels.
static size_t nsvcd__sphere_slots(size_t padded) {
  const size_t levels = nsvcd__level_count(padded);
  const nsvcd__level top = nsvcd__level_of(padded, levels - 1);
  return top.first / 4 + top.slots;
}

// Bytes of the header and the spheres.
static size_t nsvcd__spheres_size(size_t padded) {
  return sizeof(struct nsvcd_body) + 16 * nsvcd__sphere_slots(padded);
}

// Area vectors with their padding: one for each sphere, or, without levels above the groups, one
// for each patch.
static size_t nsvcd__area_slots(size_t padded) {
  return nsvcd__level_count(padded) > 1 ? nsvcd__sphere_slots(padded) : padded;
}
// (3, P)
static const float *nsvcd__body_areas(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const float *)(const void *)at;
}
// Bytes of a body of latents up to these.
static size_t nsvcd__latents_begin(size_t padded) {
  return nsvcd__spheres_size(padded) + 12 * nsvcd__area_slots(padded) +
         3 * NSVCD__EXTREMES * padded;
}

#ifndef NSVCD_NO_NETWORK
// (3, slots): the sums over a level's spheres, in a body with levels above the groups.
static const float *nsvcd__level_areas(const nsvcd_body *body, nsvcd__level level) {
  return nsvcd__body_areas(body) + level.first / 4 * 3;
}
// The extremes of a group's patches: (EXTREMES, 3, 16).
static const int8_t *nsvcd__group_extremes(const nsvcd_body *body, size_t g) {
  const float *areas_end = nsvcd__body_areas(body) + 3 * nsvcd__area_slots(body->padded);
  return (const int8_t *)areas_end + 3 * NSVCD__EXTREMES * NSVCD__GROUP * g;
}
// (N, LATENT)
static const int8_t *nsvcd__body_latents(const nsvcd_body *body) {
  return (const int8_t *)body + nsvcd__latents_begin(body->padded);
}

NSVCDDEF size_t nsvcd_body_size(size_t patches) {
  if (patches < 1 || patches > NSVCD_MAX_PATCHES) return 0;
  const size_t padded = nsvcd__round_up(patches, NSVCD__GROUP);
  const size_t latents = patches * NSVCD__LATENT;
  return nsvcd__round_up(nsvcd__latents_begin(padded) + latents, NSVCD_ALIGNMENT);
}
#endif

// FNV-1a, 64 bits, over words of 32 bits. Every step is a bijection of the state, so a change of a
// single word is always detected.
static uint64_t nsvcd__body_checksum(const nsvcd_body *body) {
  const char *bytes = (const char *)body;
  uint64_t hash = 14695981039346656037u;
  for (size_t i = offsetof(struct nsvcd_body, size); i < body->size; i += 4) {
    uint32_t word;
    memcpy(&word, bytes + i, 4);
    hash = (hash ^ word) * 1099511628211u;
  }
  return hash;
}

#ifndef NSVCD_NO_ENCODER
// Sorts patches, by numbers, by a coordinate of their centres. A merge sort: equal ones keep their
// order, so the result is the same everywhere. spare: (count).
static void nsvcd__sort_along(const nsvcd__f3 *centres, size_t axis, uint16_t *order,
                              uint16_t *spare, size_t count) {
  const float *at = (const float *)(const void *)centres + axis;
  for (size_t run = 1; run < count; run *= 2) {
    for (size_t first = 0; first < count; first += 2 * run) {
      const size_t middle = first + run < count ? first + run : count;
      const size_t end = first + 2 * run < count ? first + 2 * run : count;
      size_t left = first;
      size_t right = middle;
      for (size_t to = first; to < end; to++) {
        int from_right = left == middle;
        if (left < middle && right < end)
          from_right = at[3 * order[right]] < at[3 * order[left]];
        spare[to] = from_right ? order[right++] : order[left++];
      }
    }
    memcpy(order, spare, count * sizeof *order);
  }
}

// Orders patches so that each run of 16 is compact, and each run of 16 of those: median splits
// across the longest axis of the centres' box. The left part is a multiple of 16, or of 256 and so
// on if there are more than a tile's. spare: (count).
static void nsvcd__body_order(const nsvcd__f3 *centres, uint16_t *order, uint16_t *spare,
                              size_t count) {
  if (count <= NSVCD__GROUP) return;
  nsvcd__f3 low = centres[order[0]];
  nsvcd__f3 high = low;
  for (size_t i = 1; i < count; i++) {
    low = nsvcd__f3_min(low, centres[order[i]]);
    high = nsvcd__f3_max(high, centres[order[i]]);
  }
  const nsvcd__f3 size = nsvcd__f3_sub(high, low);
  const size_t axis = nsvcd__d3_longest(nsvcd__d3_widen(size));
  nsvcd__sort_along(centres, axis, order, spare, count);
  size_t unit = NSVCD__GROUP;
  while (2 * NSVCD__GROUP * unit < count) unit *= NSVCD__GROUP;
  const size_t left = nsvcd__round_up(count / 2, unit);
  nsvcd__body_order(centres, order, spare, left);
  nsvcd__body_order(centres, order + left, spare, count - left);
}

// What a body of latents is built of.
typedef struct nsvcd__latents {
  size_t count;        // N
  nsvcd__f3 *centres;  // (N)
  float *radii;        // (N)
  nsvcd__f3 *areas;    // (N)
  // (N, EXTREMES, 3)
  int8_t *extremes;
  int8_t *latents;  // (N, LATENT)
  // (N) of the patches
  const uint16_t *order;
  int open;
} nsvcd__latents;

// Begins a body in `memory`: zeros, the header, and the padding of the patches' spheres.
static nsvcd_body *nsvcd__body_begin(void *memory, size_t size, size_t patches, int open) {
  nsvcd_body *b = (nsvcd_body *)memory;
  memset(memory, 0, size);
  b->magic = NSVCD__BODY_MAGIC;
  b->version = NSVCD__BODY_VERSION;
  b->size = (uint32_t)size;
  b->patches = (uint32_t)patches;
  b->padded = (uint32_t)nsvcd__round_up(patches, NSVCD__GROUP);
  b->open = open != 0;
  float *radii = (float *)(b + 1) + 3 * b->padded;
  for (size_t i = patches; i < b->padded; i++) radii[i] = NSVCD__NOWHERE;
  return b;
}
#endif

// Are 16 spheres within a distance of a point, but for roundings? It takes no roots, and compilers
// vectorize it.
static int nsvcd__are_within(nsvcd__spheres all, nsvcd__f3 point, float distance) {
  int are_within = 1;
  for (size_t i = 0; i < NSVCD__GROUP; i++) {
    const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, i), point);
    const float gap = distance - all.r[i];
    are_within &= (gap > 0) & (nsvcd__f3_dot(offset, offset) < gap * gap);
  }
  return are_within;
}

// The distance from a point to the farthest point of `count` spheres. *farthest: a guess, the
// better the faster; becomes the sphere that is farthest, if the distance is above 0.
static float nsvcd__radius_about(nsvcd__spheres all, size_t count, nsvcd__f3 point,
                                 size_t *farthest) {
  const nsvcd__sphere guess = nsvcd__sphere_of(all, *farthest);
  // less than 1 by more than the roundings: the farthest sphere is never skipped
  const float fraction = 0.999998f;
  float least = fraction * (nsvcd__f3_norm(nsvcd__f3_sub(guess.centre, point)) + guess.radius);
  float radius = 0;
  for (size_t first = 0; first < count; first += NSVCD__GROUP) {
    const size_t end = first + nsvcd__group_members(count, first);
    const nsvcd__spheres some = nsvcd__spheres_from(all, first);
    if (end == first + NSVCD__GROUP && nsvcd__are_within(some, point, least)) continue;
    for (size_t i = first; i < end; i++) {
      const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, i), point);
      const float to = nsvcd__f3_norm(offset) + all.r[i];
      if (to > radius) *farthest = i;
      radius = to > radius ? to : radius;
    }
    least = fraction * radius > least ? fraction * radius : least;
  }
  return radius;
}

// A sphere over `count` spheres (Badoiu, Clarkson 2003): ever shorter steps towards the farthest
// sphere. Difference: they begin in the middle of the box, and the best one is kept. The radius is
// rounded up by more than any compiler's rounding.
static nsvcd__sphere nsvcd__cover_spheres(nsvcd__spheres all, size_t count) {
  nsvcd__f3 low = nsvcd__f3_of(HUGE_VALF, HUGE_VALF, HUGE_VALF);
  nsvcd__f3 high = nsvcd__f3_scale(low, -1);
  for (size_t i = 0; i < count; i++) {
    const nsvcd__f3 r = nsvcd__f3_of(all.r[i], all.r[i], all.r[i]);
    const nsvcd__f3 centre = nsvcd__centre_of(all, i);
    low = nsvcd__f3_min(low, nsvcd__f3_sub(centre, r));
    high = nsvcd__f3_max(high, nsvcd__f3_add(centre, r));
  }
  const nsvcd__f3 half = nsvcd__f3_scale(low, 0.5f);
  nsvcd__f3 centre = nsvcd__f3_add(half, nsvcd__f3_scale(high, 0.5f));
  nsvcd__sphere best = {centre, HUGE_VALF};
  size_t farthest = 0;
  for (int step = 0; step < 32; step++) {
    const float radius = nsvcd__radius_about(all, count, centre, &farthest);
    const nsvcd__sphere trial = {centre, radius};
    if (trial.radius < best.radius) best = trial;
    const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__centre_of(all, farthest), centre);
    const float steps = (float)(step + 3);
    centre.x += offset.x / steps;
    centre.y += offset.y / steps;
    centre.z += offset.z / steps;
  }
  best.radius *= 1.000002f;
  return best;
}

// Fills a level, (4, slots), with spheres over 16 of `members` spheres each.
static void nsvcd__cover_groups(nsvcd__spheres below, size_t members, float *out,
                                size_t slots) {
  for (size_t g = 0; g < slots; g++) {
    nsvcd__sphere sphere = {{0, 0, 0}, NSVCD__NOWHERE};
    const size_t i = g * NSVCD__GROUP;
    const size_t count = nsvcd__group_members(members, i);
    if (count) sphere = nsvcd__cover_spheres(nsvcd__spheres_from(below, i), count);
    nsvcd__sphere_store(sphere, out, slots, g);
  }
}
static void nsvcd__cover_level(nsvcd_body *body, size_t k, nsvcd__spheres below,
                               size_t members) {
  const nsvcd__level level = nsvcd__level_of(body->padded, k);
  nsvcd__cover_groups(below, members, (float *)(body + 1) + level.first, level.slots);
}

// Fills in the levels above the groups, the bounding sphere and the extent of a blob whose patches
// and groups are in place.
static void nsvcd__body_finish(nsvcd_body *body) {
  const nsvcd__spheres patches = nsvcd__body_patches(body);
  const nsvcd__spheres groups = nsvcd__groups_of(body);
  for (size_t k = 1; k < nsvcd__level_count(body->padded); k++) {
    const nsvcd__level below = nsvcd__level_of(body->padded, k - 1);
    nsvcd__cover_level(body, k, nsvcd__level_spheres(body, below), below.count);
  }
  size_t farthest = 0;
  const nsvcd__f3 origin = nsvcd__f3_of(0, 0, 0);
  const nsvcd__sphere over = nsvcd__cover_spheres(patches, body->patches);
  const nsvcd__sphere above = nsvcd__cover_spheres(groups, nsvcd__body_groups(body));
  const nsvcd__sphere sphere = above.radius < over.radius ? above : over;
  const float extent = nsvcd__radius_about(patches, body->patches, origin, &farthest);
  nsvcd__f3_store(sphere.centre, body->centre);
  body->radius = sphere.radius;
  body->extent = extent * 1.000002f;
}

// Are the area vectors of a body of latents in range?
static int nsvcd__areas_are_sound(const nsvcd_body *body) {
  return nsvcd__in_range(nsvcd__body_areas(body), 3 * nsvcd__area_slots(body->padded),
                         NSVCD__MAX_LENGTH * NSVCD__MAX_LENGTH);
}

#if !defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_NETWORK)
// Builds a body of latents in `memory`, nsvcd_body_size bytes. NUMBER if something is out of range,
// EMPTY if it is too small.
static nsvcd_result nsvcd__body_build(const nsvcd__latents *all, void *memory) {
  const size_t count = all->count;
  nsvcd_body *b = nsvcd__body_begin(memory, nsvcd_body_size(count), count, all->open);
  const size_t padded = b->padded;
  b->weights_id = NSVCD_WEIGHTS_ID;
  float *spheres = (float *)(b + 1);
  float *areas = (float *)nsvcd__writable(b, nsvcd__body_areas(b));
  int8_t *extremes = (int8_t *)nsvcd__writable(b, nsvcd__group_extremes(b, 0));
  int8_t *latents = (int8_t *)nsvcd__writable(b, nsvcd__body_latents(b));
  for (size_t i = 0; i < count; i++) {
    const size_t n = all->order[i];
    const nsvcd__sphere sphere = {all->centres[n], all->radii[n]};
    nsvcd__sphere_store(sphere, spheres, padded, i);
    nsvcd__f3_put(all->areas[n], areas + i, padded);
    const size_t lane = i % NSVCD__GROUP;
    int8_t *group = extremes + 3 * NSVCD__EXTREMES * (i - lane) + lane;
    for (size_t k = 0; k < 3 * NSVCD__EXTREMES; k++)
      group[NSVCD__GROUP * k] = all->extremes[3 * NSVCD__EXTREMES * n + k];
    memcpy(latents, all->latents + NSVCD__LATENT * n, NSVCD__LATENT);
    latents += NSVCD__LATENT;
  }
  // If there are levels above the groups, all levels have sums over what is below.
  const size_t levels = nsvcd__level_count(padded);
  const float *below = areas;
  size_t stride = padded;
  for (size_t n = 0; levels > 1 && n < levels; n++) {
    const nsvcd__level level = nsvcd__level_of(padded, n);
    float *sums = areas + level.first / 4 * 3;
    for (size_t i = 0; i < 3 * stride; i++)
      sums[i / stride * level.slots + i % stride / NSVCD__GROUP] += below[i];
    below = sums;
    stride = level.slots;
  }
  int sound = nsvcd__in_range(spheres, 3 * padded, NSVCD_MAX_COORDINATE);
  sound = sound && nsvcd__in_range(nsvcd__body_r(b), count, 4 * NSVCD_MAX_COORDINATE);
  if (!sound || !nsvcd__areas_are_sound(b)) return NSVCD_ERROR_NUMBER;
  nsvcd__cover_level(b, 0, nsvcd__body_patches(b), count);
  nsvcd__body_finish(b);
  b->checksum = nsvcd__body_checksum(b);
  return b->radius < NSVCD_MIN_RADIUS ? NSVCD_ERROR_EMPTY : NSVCD_OK;
}
#endif
