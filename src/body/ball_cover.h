// In: a mesh. Out: a few balls that cover it tightly: for looks.
//
// THE COVER. A ball about the centre of a cell reaches the nearest cell outside, and `slack` beyond
// it. Of such balls those that cover most of what is not yet covered are taken, one after another;
// the slack is the least, by bisection, with which so many are enough. Then balls grow until each
// triangle is in their union, and what they stick out of the mesh is measured on its triangles.
// Source: the greedy cover is Chvatal's (1979); the rest is this library's.
#pragma once
#include "../ground/triangles.h"
#include "body.h"
#include "voxels.h"

#ifndef NSVCD_NO_ENCODER
// points that the bisection covers, of the surface and of what it encloses; balls that it chooses
// from; at most
#define NSVCD__COVER_POINTS 8192
#define NSVCD__COVER_INNER 2048
#define NSVCD__COVER_CHOICES 2048
// cells of the first steps from a choice to one that covers more
#define NSVCD__COVER_CLIMB 4
// halvings of the logarithm of the slack
#define NSVCD__COVER_STEPS 7
// of a cell: triangles with longer edges are divided before a ball grows for them
#define NSVCD__COVER_FINEST 0.5

typedef struct nsvcd__ball_cover {
  // (count); of each row of 16, neighbours
  nsvcd__f3 *centres;
  float *radii;
  size_t count;
  // metres: no point of a ball is farther from the solid
  float error;
} nsvcd__ball_cover;

// A cover in the making.
typedef struct nsvcd__coverer {
  nsvcd__voxels voxels;
  // (point_count) cells to be covered; (choice_count) cells that balls can be about
  uint32_t *points, *choices;
  size_t point_count, choice_count;
  // (point_count): where the points are, in cells
  nsvcd__f3 *places;
  // (choices, words): which points a ball covers; (words): which are not covered yet; which the
  // ball covers that was tried last
  uint64_t *covered, *left, *tried;
  size_t words;
  // (choices): the most that a ball can still cover
  uint32_t *gains;
  // (most)
  nsvcd__d3 *centres;
  double *radii;
  size_t count, most;
} nsvcd__coverer;

// Every so many-th cell of some kinds, a bit for each, `most` at the most.
static size_t nsvcd__choose_cells(const nsvcd__voxels *v, unsigned kinds, size_t most,
                                  uint32_t *out) {
  size_t all = 0;
  size_t seen = 0;
  size_t count = 0;
  for (size_t n = 0; n < v->count; n++) all += kinds >> v->kinds[n] & 1;
  for (size_t n = 0; n < v->count; n++) {
    if (!(kinds >> v->kinds[n] & 1)) continue;
    if (seen++ * most / all >= count && count < most) out[count++] = (uint32_t)n;
  }
  return count;
}

// Chooses the points to cover; in words of 64, of either kind.
static void nsvcd__choose_points(nsvcd__coverer *c) {
  const nsvcd__voxels *v = &c->voxels;
  uint32_t *points = c->points;
  size_t count =
      nsvcd__choose_cells(v, 1u << NSVCD__VOXEL_SURFACE, NSVCD__COVER_POINTS, points);
  for (; count % 64; count++) points[count] = points[count - 1];
  count +=
      nsvcd__choose_cells(v, 1u << NSVCD__VOXEL_HOLLOW, NSVCD__COVER_INNER, points + count);
  c->point_count = count;
  for (size_t p = 0; p < count; p++) c->places[p] = nsvcd__cell_place(v, points[p]);
}

// Which points does the ball about a cell cover? slack: metres. covered: (words). Returns how many.
static uint32_t nsvcd__covered_by(const nsvcd__coverer *c, size_t cell, double slack,
                                  uint64_t *covered) {
  // in cells
  const float radius = c->voxels.depths[cell] + (float)(slack / c->voxels.edge);
  const nsvcd__f3 centre = nsvcd__cell_place(&c->voxels, cell);
  uint32_t count = 0;
  for (size_t w = 0; w < c->words; w++) {
    const size_t first = 64 * w;
    const size_t end = first + 64 < c->point_count ? first + 64 : c->point_count;
    covered[w] = 0;
    // points of a word are in the order of cells: z rises
    if (first >= end || c->places[first].z > centre.z + radius ||
        c->places[end - 1].z < centre.z - radius)
      continue;
    for (size_t p = first; p < end; p++) {
      const nsvcd__f3 offset = nsvcd__f3_sub(c->places[p], centre);
      const uint64_t is_in = nsvcd__f3_dot(offset, offset) <= radius * radius;
      covered[w] |= is_in << (p - first);
    }
    count += (uint32_t)nsvcd__bit_count(covered[w]);
  }
  return count;
}

// How many of the points that a ball covers, (words), are left?
static uint32_t nsvcd__gain_by(const nsvcd__coverer *c, const uint64_t *covered) {
  uint32_t gain = 0;
  for (size_t w = 0; w < c->words; w++)
    gain += (uint32_t)nsvcd__bit_count(covered[w] & c->left[w]);
  return gain;
}

// The same of the ball about a cell; what it covers is left in c->tried.
static uint32_t nsvcd__gain_of(nsvcd__coverer *c, size_t cell, double slack) {
  (void)nsvcd__covered_by(c, cell, slack, c->tried);
  return nsvcd__gain_by(c, c->tried);
}

// Goes from a cell to others near by, as long as their balls cover more.
static size_t nsvcd__climb_from(nsvcd__coverer *c, size_t cell, double slack) {
  const nsvcd__voxels *v = &c->voxels;
  uint32_t best = nsvcd__gain_of(c, cell, slack);
  for (size_t step = NSVCD__COVER_CLIMB; step > 0; step /= 2) {
    for (size_t n = 0; n < 6; n++) {
      const size_t stride = nsvcd__voxel_stride(v, n / 2);
      const size_t at = cell / stride % v->sizes[n / 2];
      if (n % 2 ? at < step : at + step >= v->sizes[n / 2]) continue;
      const size_t next = n % 2 ? cell - step * stride : cell + step * stride;
      if (v->kinds[next] == NSVCD__VOXEL_OUTSIDE) continue;
      const uint32_t gain = nsvcd__gain_of(c, next, slack);
      if (gain <= best) continue;
      best = gain;
      cell = next;
    }
  }
  return cell;
}

// The choice that covers most. Gains only become less, so the first that keeps its own when it is
// counted again is the best. Where none covers anything, it is a point that is left.
static size_t nsvcd__best_choice(nsvcd__coverer *c) {
  for (;;) {
    size_t best = 0;
    for (size_t n = 0; n < c->choice_count; n++) {
      if (c->gains[n] > c->gains[best]) best = n;
    }
    const uint32_t gain = nsvcd__gain_by(c, c->covered + best * c->words);
    if (gain > 0 && gain == c->gains[best]) return c->choices[best];
    if (c->gains[best] == 0) break;
    c->gains[best] = gain;
  }
  size_t w = 0;
  while (!c->left[w]) w++;
  return c->points[64 * w + nsvcd__low_bit(c->left[w])];
}

// Takes the balls of a slack, greedily. Returns 0 where `most` of them are not enough.
static int nsvcd__cover_with(nsvcd__coverer *c, double slack) {
  const nsvcd__voxels *v = &c->voxels;
  memset(c->left, 0, c->words * sizeof *c->left);
  for (size_t p = 0; p < c->point_count; p++) c->left[p / 64] |= (uint64_t)1 << p % 64;
  for (size_t n = 0; n < c->choice_count; n++)
    c->gains[n] = nsvcd__covered_by(c, c->choices[n], slack, c->covered + n * c->words);
  size_t to_cover = c->point_count;
  for (c->count = 0; to_cover > 0; c->count++) {
    if (c->count == c->most) return 0;
    const size_t cell = nsvcd__climb_from(c, nsvcd__best_choice(c), slack);
    c->centres[c->count] = nsvcd__voxel_centre(v, cell);
    c->radii[c->count] = (double)v->depths[cell] * v->edge + slack;
    to_cover -= nsvcd__gain_of(c, cell, slack);
    for (size_t w = 0; w < c->words; w++) c->left[w] &= ~c->tried[w];
  }
  return 1;
}

// Grows balls until a triangle is in their union. *last: the ball that was enough before.
static void nsvcd__grow_over(nsvcd__coverer *c, const nsvcd__d3 *t, size_t *last) {
  double best = HUGE_VAL;
  size_t nearest = 0;
  for (size_t i = 0; i < c->count; i++) {
    const size_t n = i == 0 ? *last : i == *last ? 0 : i;
    double farthest = 0;
    for (size_t k = 0; k < 3; k++)
      farthest = nsvcd__max(farthest, nsvcd__d3_distance2(t[k], c->centres[n]));
    const double missing = sqrt(farthest) - c->radii[n];
    if (missing < best) nearest = n;
    best = nsvcd__min(best, missing);
    if (best <= 0) break;
  }
  *last = nearest;
  if (best <= 0) return;
  size_t longest = 0;
  double length = 0;
  for (size_t k = 0; k < 3; k++) {
    const double edge = nsvcd__d3_distance2(t[k], t[(k + 1) % 3]);
    if (edge > length) longest = k;
    length = nsvcd__max(length, edge);
  }
  const double finest = NSVCD__COVER_FINEST * c->voxels.edge;
  if (!(length > finest * finest)) {
    c->radii[nearest] += best;
    return;
  }
  const nsvcd__d3 a = t[longest];
  const nsvcd__d3 b = t[(longest + 1) % 3];
  const nsvcd__d3 opposite = t[(longest + 2) % 3];
  const nsvcd__d3 middle = nsvcd__d3_mix(a, b, 0.5);
  const nsvcd__d3 halves[2][3] = {{a, middle, opposite}, {middle, b, opposite}};
  nsvcd__grow_over(c, halves[0], last);
  nsvcd__grow_over(c, halves[1], last);
}

// How far the balls go beyond the solid, at most. If a centre is inside, at a depth d, no point of
// its ball is farther from the solid than the radius less d; if it is outside, at a height d, than
// the radius plus d. The depth is that of the nearest triangle, or by the cells, where that is
// more: within a solid of several components there are triangles of the others. depths: (count).
static double nsvcd__cover_error(const nsvcd__coverer *c, const nsvcd_mesh *mesh,
                                 double *depths) {
  for (size_t n = 0; n < c->count; n++) depths[n] = HUGE_VAL;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__d3 corners[3];
    nsvcd__mesh_triangle(mesh, t, corners);
    const double reach = sqrt(nsvcd__max(nsvcd__d3_distance2(corners[0], corners[1]),
                                         nsvcd__d3_distance2(corners[0], corners[2])));
    for (size_t n = 0; n < c->count; n++) {
      const nsvcd__d3 centre[3] = {c->centres[n], c->centres[n], c->centres[n]};
      const double nearest = depths[n] + reach;
      if (nsvcd__d3_distance2(centre[0], corners[0]) > nearest * nearest) continue;
      depths[n] = nsvcd__min(depths[n], sqrt(nsvcd__nearest_of(centre, corners).square));
    }
  }
  double worst = 0;
  for (size_t n = 0; n < c->count; n++) {
    const size_t cell = nsvcd__voxel_at(&c->voxels, c->centres[n]);
    const int is_inside = c->voxels.kinds[cell] == NSVCD__VOXEL_HOLLOW ||
                          nsvcd__is_voted_inside(&c->voxels, cell);
    const double by_cells = ((double)c->voxels.depths[cell] - 2) * c->voxels.edge;
    const double depth = is_inside ? nsvcd__max(depths[n], by_cells) : -depths[n];
    worst = nsvcd__max(worst, c->radii[n] - depth);
  }
  return worst;
}

// Takes a cover's memory. 0 without.
static int nsvcd__coverer_take(nsvcd__coverer *c, size_t most, nsvcd__arena *arena) {
  const size_t points = NSVCD__COVER_POINTS + NSVCD__COVER_INNER;
  memset(c, 0, sizeof *c);
  c->most = most;
  c->words = points / 64;
  c->points = NSVCD__TAKE(arena, uint32_t, points);
  c->places = NSVCD__TAKE(arena, nsvcd__f3, points);
  c->choices = NSVCD__TAKE(arena, uint32_t, NSVCD__COVER_CHOICES);
  c->gains = NSVCD__TAKE(arena, uint32_t, NSVCD__COVER_CHOICES);
  c->covered = NSVCD__TAKE(arena, uint64_t, NSVCD__COVER_CHOICES * c->words);
  c->left = NSVCD__TAKE(arena, uint64_t, c->words);
  c->tried = NSVCD__TAKE(arena, uint64_t, c->words);
  c->centres = NSVCD__TAKE(arena, nsvcd__d3, most);
  c->radii = NSVCD__TAKE(arena, double, most);
  return !arena->failed;
}

// Takes the balls of the least slack with which they are enough, and grows them over all triangles.
static void nsvcd__cover_mesh(nsvcd__coverer *c, const nsvcd_mesh *mesh) {
  const unsigned within = 1u << NSVCD__VOXEL_SURFACE | 1u << NSVCD__VOXEL_HOLLOW;
  nsvcd__choose_points(c);
  c->choice_count = nsvcd__choose_cells(&c->voxels, within, NSVCD__COVER_CHOICES, c->choices);
  // with the last of these one ball is enough
  double low = 0.25 * c->voxels.edge;
  double high = 2 * (double)(NSVCD__VOXELS + 2 * NSVCD__VOXEL_RIM) * c->voxels.edge;
  for (int step = 0; step < NSVCD__COVER_STEPS; step++) {
    const double middle = sqrt(low * high);
    *(nsvcd__cover_with(c, middle) ? &high : &low) = middle;
  }
  (void)nsvcd__cover_with(c, high);
  size_t last = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__d3 corners[3];
    nsvcd__mesh_triangle(mesh, t, corners);
    nsvcd__grow_over(c, corners, &last);
  }
}

// Covers a checked mesh, no cloud, by o->balls balls at the most. 0 without memory. out: taken from
// the arena.
static int nsvcd__ball_cover_build(const nsvcd_mesh *mesh, const nsvcd_encode_options *o,
                                   nsvcd__arena *arena, nsvcd__ball_cover *out) {
  nsvcd__coverer c;
  nsvcd__arena spare = nsvcd__arena_of(arena->allocator);
  const size_t most = o->balls;
  int ok = nsvcd__coverer_take(&c, most, &spare);
  double *depths = NSVCD__TAKE(&spare, double, most);
  uint16_t *order = NSVCD__TAKE(&spare, uint16_t, 2 * most);
  nsvcd__f3 *centres = NSVCD__TAKE(&spare, nsvcd__f3, most);
  out->centres = NSVCD__TAKE(arena, nsvcd__f3, most);
  out->radii = NSVCD__TAKE(arena, float, most);
  ok = ok && !arena->failed && !spare.failed &&
       nsvcd__voxels_build(mesh, o->open, &spare, &c.voxels);
  if (ok) {
    nsvcd__cover_mesh(&c, mesh);
    for (size_t n = 0; n < c.count; n++) {
      centres[n] = nsvcd__f3_round(c.centres[n]);
      order[n] = (uint16_t)n;
    }
    nsvcd__body_order(centres, order, order + most, c.count);
    double rounding = 0;
    for (size_t n = 0; n < c.count; n++) {
      const double radius = c.radii[order[n]] + (double)o->convex_radius;
      const double length = nsvcd__d3_norm(c.centres[order[n]]) + radius;
      rounding = nsvcd__max(rounding, 1e-6 * length);
      out->centres[n] = centres[order[n]];
      out->radii[n] = nsvcd__above(radius + 5e-7 * length);
    }
    out->count = c.count;
    out->error = nsvcd__above(nsvcd__cover_error(&c, mesh, depths) + rounding);
  }
  nsvcd__arena_free(&spare);
  return ok;
}
#endif
