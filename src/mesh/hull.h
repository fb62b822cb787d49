// In: points. Out: their convex hull, a closed mesh.
//
// Quickhull (Barber, Dobkin and Huhdanpaa 1996) on a grid. Along each axis the box of the points
// has up to 2^30 steps, and coordinates are rounded to whole steps. Then which side of a facet a
// point is on is an integer that is computed exactly. So no tolerance is needed, and what is built
// is closed and convex on the grid, whatever the points are. That steps differ from axis to axis
// does not matter, since a hull stays a hull if it is stretched.
//
// The mesh has the points themselves as its vertices. Each is within half a step of where it is on
// the grid, along each axis, and so is each point of a facet. A point of the caller's is therefore
// at most one step outside.
#pragma once
#include "mesh.h"

#ifndef NSVCD_NO_ENCODER
#define NSVCD__GRID_BITS 30
#define NSVCD__NO_INDEX 0xffffffffu

typedef struct nsvcd__facet {
  int64_t normal[3];
  uint32_t corners[3];
  // across the edge from corner k to the next one
  uint32_t beyond[3];
  // the first of the points outside that are left to it
  uint32_t outside;
  // the next one that is visible, new or free
  uint32_t link;
  // the next one that waits
  uint32_t below;
  uint8_t is_dead, is_visible, is_waiting;
} nsvcd__facet;

typedef struct nsvcd__quickhull {
  nsvcd__arena arena;
  size_t count;
  // (count, 3) steps, 0 to 2^30
  int32_t *grid;
  // (count) the caller's number of a point
  uint32_t *names;
  // (count) the next point outside of the same facet
  uint32_t *next;
  // (count) the new facet whose base starts at a point; in the end how many edges end there
  uint32_t *fan;
  nsvcd__facet *facets;
  size_t room, used;
  uint32_t free, waiting;
} nsvcd__quickhull;

// How far point q is above a facet, in units of the facet. Its sign is exact: a normal is up to
// 2^61, and its halves of 30 bits are multiplied apart.
static double nsvcd__facet_height(const nsvcd__quickhull *h, const nsvcd__facet *f, size_t q) {
  const int64_t half = (int64_t)1 << NSVCD__GRID_BITS;
  const int32_t *from = h->grid + 3 * (size_t)f->corners[0];
  const int32_t *to = h->grid + 3 * q;
  int64_t upper = 0;
  int64_t lower = 0;
  for (size_t k = 0; k < 3; k++) {
    const int64_t offset = (int64_t)to[k] - from[k];
    upper += f->normal[k] / half * offset;
    lower += f->normal[k] % half * offset;
  }
  return (double)(upper + lower / half) * (double)half + (double)(lower % half);
}

static void nsvcd__facet_span(const nsvcd__quickhull *h, nsvcd__facet *f) {
  int64_t u[3];
  int64_t v[3];
  for (size_t k = 0; k < 3; k++) {
    const int32_t from = h->grid[3 * (size_t)f->corners[0] + k];
    u[k] = (int64_t)h->grid[3 * (size_t)f->corners[1] + k] - from;
    v[k] = (int64_t)h->grid[3 * (size_t)f->corners[2] + k] - from;
  }
  for (size_t k = 0; k < 3; k++) {
    const size_t l = (k + 1) % 3;
    const size_t m = (k + 2) % 3;
    f->normal[k] = u[l] * v[m] - u[m] * v[l];
  }
}

// A new facet; NSVCD__NO_INDEX without memory.
static uint32_t nsvcd__add_facet(nsvcd__quickhull *h, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t at = h->free;
  if (at != NSVCD__NO_INDEX) {
    h->free = h->facets[at].link;
  } else {
    if (h->used == h->room) {
      const size_t size = sizeof *h->facets;
      void *more = nsvcd__arena_grow(&h->arena, h->facets, h->used * size, 2 * h->room, size);
      if (!more) return NSVCD__NO_INDEX;
      h->facets = (nsvcd__facet *)more;
      h->room *= 2;
    }
    at = (uint32_t)h->used++;
    h->facets[at].is_waiting = 0;
  }
  nsvcd__facet *f = h->facets + at;
  f->corners[0] = a;
  f->corners[1] = b;
  f->corners[2] = c;
  f->outside = NSVCD__NO_INDEX;
  f->is_dead = f->is_visible = 0;
  nsvcd__facet_span(h, f);
  return at;
}

// Leaves a point to the first facet of a list that it is above, if it is above one. Points that
// follow each other are often above the same one, which is tried first.
static void nsvcd__leave_point(nsvcd__quickhull *h, uint32_t q, uint32_t list,
                               uint32_t *recent) {
  uint32_t at = *recent;
  if (!(nsvcd__facet_height(h, h->facets + at, q) > 0)) {
    at = list;
    while (at != NSVCD__NO_INDEX && !(nsvcd__facet_height(h, h->facets + at, q) > 0))
      at = h->facets[at].link;
  }
  if (at == NSVCD__NO_INDEX) return;
  nsvcd__facet *f = h->facets + at;
  *recent = at;
  h->next[q] = f->outside;
  f->outside = q;
  if (f->is_waiting) return;
  f->is_waiting = 1;
  f->below = h->waiting;
  h->waiting = at;
}

// What a point sees of the hull, from one facet on, a list; and new facets from its edge to the
// point, a list as well, which are joined to what stays. 0 without memory.
static int nsvcd__raise_fan(nsvcd__quickhull *h, uint32_t point, uint32_t visible,
                            uint32_t *fan) {
  uint32_t last = visible;
  *fan = NSVCD__NO_INDEX;
  h->facets[visible].is_visible = 1;
  h->facets[visible].link = NSVCD__NO_INDEX;
  for (uint32_t at = visible; at != NSVCD__NO_INDEX; at = h->facets[at].link) {
    for (size_t k = 0; k < 3; k++) {
      const uint32_t a = h->facets[at].corners[k];
      const uint32_t b = h->facets[at].corners[(k + 1) % 3];
      const uint32_t across = h->facets[at].beyond[k];
      nsvcd__facet *other = h->facets + across;
      if (other->is_visible) continue;
      if (nsvcd__facet_height(h, other, point) > 0) {
        other->is_visible = 1;
        other->link = NSVCD__NO_INDEX;
        h->facets[last].link = across;
        last = across;
        continue;
      }
      const uint32_t added = nsvcd__add_facet(h, a, b, point);
      if (added == NSVCD__NO_INDEX) return 0;
      other = h->facets + across;
      other->beyond[other->corners[0] == b ? 0 : other->corners[1] == b ? 1 : 2] = added;
      h->facets[added].beyond[0] = across;
      h->facets[added].link = *fan;
      h->fan[a] = *fan = added;
    }
  }
  for (uint32_t at = *fan; at != NSVCD__NO_INDEX; at = h->facets[at].link) {
    const uint32_t after = h->fan[h->facets[at].corners[1]];
    h->facets[at].beyond[1] = after;
    h->facets[after].beyond[2] = at;
  }
  return 1;
}

static uint32_t nsvcd__farthest_outside(const nsvcd__quickhull *h, const nsvcd__facet *f) {
  uint32_t out = f->outside;
  double highest = 0;
  for (uint32_t q = f->outside; q != NSVCD__NO_INDEX; q = h->next[q]) {
    const double height = nsvcd__facet_height(h, f, q);
    if (height > highest) out = q;
    highest = nsvcd__max(height, highest);
  }
  return out;
}

// Adds points until none is outside. 0 without memory.
static int nsvcd__grow_hull(nsvcd__quickhull *h) {
  while (h->waiting != NSVCD__NO_INDEX) {
    const uint32_t first = h->waiting;
    nsvcd__facet *f = h->facets + first;
    h->waiting = f->below;
    f->is_waiting = 0;
    if (f->is_dead || f->outside == NSVCD__NO_INDEX) continue;
    const uint32_t point = nsvcd__farthest_outside(h, f);
    uint32_t fan;
    if (!nsvcd__raise_fan(h, point, first, &fan)) return 0;
    uint32_t recent = fan;
    uint32_t after;
    for (uint32_t at = first; at != NSVCD__NO_INDEX; at = after) {
      uint32_t q = h->facets[at].outside;
      while (q != NSVCD__NO_INDEX) {
        const uint32_t other = h->next[q];
        if (q != point) nsvcd__leave_point(h, q, fan, &recent);
        q = other;
      }
      after = h->facets[at].link;
      h->facets[at].is_dead = 1;
      h->facets[at].link = h->free;
      h->free = at;
    }
  }
  return 1;
}

// The point farthest from corner 0 of a facet; from the line through the first two; from the plane
// of all three. 0 if all are on it.
static int nsvcd__next_corner(const nsvcd__quickhull *h, nsvcd__facet *f, size_t corners,
                              uint32_t *out) {
  double highest = 0;
  for (size_t q = 0; q < h->count; q++) {
    double height = 0;
    if (corners == 2) f->corners[2] = (uint32_t)q;
    if (corners == 2) nsvcd__facet_span(h, f);
    for (size_t k = 0; k < 3; k++) {
      const int32_t from = h->grid[3 * (size_t)f->corners[0] + k];
      const double offset =
          corners == 1 ? (double)h->grid[3 * q + k] - (double)from : (double)f->normal[k];
      height += offset * offset;
    }
    if (corners == 3) height = fabs(nsvcd__facet_height(h, f, q));
    if (height > highest) *out = (uint32_t)q;
    highest = nsvcd__max(height, highest);
  }
  return highest > 0;
}

// Four points that span a volume, and who is outside of which facet. NSVCD_ERROR_EMPTY if all are
// in a plane.
static nsvcd_result nsvcd__start_hull(nsvcd__quickhull *h) {
  nsvcd__facet f;
  uint32_t d = 0;
  memset(&f, 0, sizeof f);
  for (size_t k = 1; k < 4; k++) {
    if (!nsvcd__next_corner(h, &f, k, &d)) return NSVCD_ERROR_EMPTY;
    if (k < 3) f.corners[k] = d;
    nsvcd__facet_span(h, &f);
  }
  // a triangle with two sides, one of which sees the fourth point
  const uint32_t c[3] = {f.corners[0], f.corners[1], f.corners[2]};
  const int is_above = nsvcd__facet_height(h, &f, d) > 0;
  const uint32_t seen = nsvcd__add_facet(h, c[0], c[is_above ? 1 : 2], c[is_above ? 2 : 1]);
  const uint32_t base = nsvcd__add_facet(h, c[0], c[is_above ? 2 : 1], c[is_above ? 1 : 2]);
  for (size_t k = 0; k < 3; k++) {
    h->facets[seen].beyond[k] = base;
    h->facets[base].beyond[k] = seen;
  }
  uint32_t fan;
  if (!nsvcd__raise_fan(h, d, seen, &fan)) return NSVCD_ERROR_MEMORY;
  h->facets[seen].is_dead = 1;
  h->facets[seen].link = NSVCD__NO_INDEX;
  h->free = seen;
  h->facets[base].link = fan;
  uint32_t recent = base;
  for (size_t q = 0; q < h->count; q++) nsvcd__leave_point(h, (uint32_t)q, base, &recent);
  return NSVCD_OK;
}

// Rounds the points to steps of their box. 0 if that is flat.
static int nsvcd__points_to_grid(const float *points, size_t count, int32_t *grid) {
  for (size_t k = 0; k < 3; k++) {
    double low = (double)points[k];
    double high = low;
    int exponent;
    for (size_t i = 1; i < count; i++) {
      low = nsvcd__min(low, (double)points[3 * i + k]);
      high = nsvcd__max(high, (double)points[3 * i + k]);
    }
    if (!(high > low)) return 0;
    (void)frexp(high - low, &exponent);
    // a power of two, so that a float of that size or larger is where it was
    const double step = ldexp(1, exponent - NSVCD__GRID_BITS);
    const double first = floor(low / step + 0.5);
    for (size_t i = 0; i < count; i++)
      grid[3 * i + k] = (int32_t)(floor((double)points[3 * i + k] / step + 0.5) - first);
  }
  return 1;
}

// Keeps only the points that are corners of the hull: at least three edges end there whose facets
// are not in one plane. Returns how many others there were.
static size_t nsvcd__keep_corners(nsvcd__quickhull *h) {
  const size_t before = h->count;
  memset(h->fan, 0, before * sizeof *h->fan);
  for (size_t n = 0; n < h->used; n++) {
    const nsvcd__facet *f = h->facets + n;
    for (size_t k = 0; k < 9 && !f->is_dead; k++) {
      const uint32_t corner = h->facets[f->beyond[k / 3]].corners[k % 3];
      if (nsvcd__facet_height(h, f, corner) < 0) h->fan[f->corners[k / 3]]++;
    }
  }
  h->count = 0;
  for (size_t i = 0; i < before; i++) {
    if (h->fan[i] < 3) continue;
    h->names[h->count] = h->names[i];
    memmove(h->grid + 3 * h->count++, h->grid + 3 * i, 3 * sizeof *h->grid);
  }
  return before - h->count;
}

// The facets as a mesh of the caller's points, which are all corners.
static nsvcd_result nsvcd__hull_mesh(const nsvcd__quickhull *h, const float *points,
                                     const nsvcd_allocator *alloc, nsvcd_mesh *mesh) {
  nsvcd_mesh out;
  if (!nsvcd__mesh_alloc(&out, h->count, 2 * h->count - 4, alloc)) {
    nsvcd_mesh_free(&out, alloc);
    return NSVCD_ERROR_MEMORY;
  }
  for (size_t i = 0; i < h->count; i++)
    memcpy(out.positions + 3 * i, points + 3 * (size_t)h->names[i], 3 * sizeof *points);
  uint32_t *corner = out.indices;
  for (size_t n = 0; n < h->used; n++) {
    for (size_t k = 0; k < 3 && !h->facets[n].is_dead; k++)
      *corner++ = h->facets[n].corners[k];
  }
  *mesh = out;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_mesh_hull(const float *points, size_t count,
                                      const nsvcd_allocator *alloc, nsvcd_mesh *hull) {
  nsvcd__quickhull h;
  if (!points || !hull) return NSVCD_ERROR_ARGUMENT;
  if (count > NSVCD__MAX_COUNT) return NSVCD_ERROR_TOO_LARGE;
  if (!nsvcd__in_range(points, 3 * count, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  if (count < 4) return NSVCD_ERROR_EMPTY;
  memset(&h, 0, sizeof h);
  h.arena = nsvcd__arena_of(alloc);
  h.count = count;
  h.room = 64;
  h.grid = NSVCD__TAKE(&h.arena, int32_t, 3 * count);
  h.names = NSVCD__TAKE(&h.arena, uint32_t, count);
  h.next = NSVCD__TAKE(&h.arena, uint32_t, count);
  h.fan = NSVCD__TAKE(&h.arena, uint32_t, count);
  h.facets = NSVCD__TAKE(&h.arena, nsvcd__facet, h.room);
  nsvcd_result result = h.arena.failed ? NSVCD_ERROR_MEMORY : NSVCD_OK;
  if (!result && !nsvcd__points_to_grid(points, count, h.grid)) result = NSVCD_ERROR_EMPTY;
  for (size_t i = 0; i < count && !result; i++) h.names[i] = (uint32_t)i;
  do {
    h.used = 0;
    h.free = h.waiting = NSVCD__NO_INDEX;
    if (!result) result = nsvcd__start_hull(&h);
    if (!result && !nsvcd__grow_hull(&h)) result = NSVCD_ERROR_MEMORY;
    // again, until there are corners alone, whose numbers are then those of the mesh
  } while (!result && nsvcd__keep_corners(&h) > 0);
  if (!result) result = nsvcd__hull_mesh(&h, points, alloc, hull);
  nsvcd__arena_free(&h.arena);
  return result;
}
#endif
