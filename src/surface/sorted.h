// In: pieces. Out: the pieces sorted by patch; and, for the network, the extremes of each patch:
// eight points whose hull is nearly that of all its surface.
#pragma once
#include "pieces.h"
#include "hulls.h"

#ifndef NSVCD_NO_ENCODER
// Pieces by patch, and working memory for one patch at a time. A pass numbers the points that it
// meets.
typedef struct nsvcd__sorted {
  const nsvcd__pieces *pieces;
  // (N + 1) where the pieces of a patch begin in `order`
  size_t *first;
  // (pieces) their numbers; in a patch as they were made
  uint32_t *order;
  uint32_t pass;  // from 1
  // (points) the last pass that met a point, and its number in that pass
  uint32_t *stamps, *numbers;
  // (met_count) points of the pass, their positions about a centre, and working memory
  uint32_t *met;
  nsvcd__d3 *positions, *nearest;
  double *bounds;
  size_t met_count;
} nsvcd__sorted;

static const nsvcd__piece *nsvcd__sorted_piece(const nsvcd__sorted *all, size_t k) {
  return (const nsvcd__piece *)all->pieces->list.items + all->order[k];
}

// Sorts the pieces by patch (counting sort). 0 without memory.
static int nsvcd__sorted_build(const nsvcd__pieces *pieces, nsvcd__arena *arena,
                               nsvcd__sorted *all) {
  const nsvcd__piece *items = (const nsvcd__piece *)pieces->list.items;
  const size_t patches = pieces->patches->count;
  const size_t count = pieces->list.count;
  const size_t points = pieces->region->mesh.vertex_count + pieces->points.count;
  size_t *first = NSVCD__TAKE(arena, size_t, patches + 1);
  memset(all, 0, sizeof *all);
  all->pieces = pieces;
  all->first = first;
  all->order = NSVCD__TAKE(arena, uint32_t, count);
  all->stamps = NSVCD__TAKE(arena, uint32_t, points);
  all->numbers = NSVCD__TAKE(arena, uint32_t, points);
  if (arena->failed) return 0;
  for (size_t k = 0; k < count; k++) first[items[k].patch + 1]++;
  for (size_t i = 0; i < patches; i++) first[i + 1] += first[i];
  for (size_t k = count; k-- > 0;) all->order[--first[items[k].patch + 1]] = (uint32_t)k;
  // now first[i + 1] is where patch i begins
  memmove(first, first + 1, patches * sizeof *first);
  first[patches] = count;

  size_t most = 0;
  for (size_t i = 0; i < patches; i++) {
    // the hull's points have numbers of their own
    size_t corners = NSVCD__HULL;
    for (size_t k = first[i]; k < first[i + 1]; k++)
      corners += nsvcd__sorted_piece(all, k)->count;
    most = corners > most ? corners : most;
  }
  all->met = NSVCD__TAKE(arena, uint32_t, most);
  all->positions = NSVCD__TAKE(arena, nsvcd__d3, most);
  all->nearest = NSVCD__TAKE(arena, nsvcd__d3, most);
  all->bounds = NSVCD__TAKE(arena, double, most);
  return !arena->failed;
}

static void nsvcd__begin_pass(nsvcd__sorted *all) {
  all->pass++;
  all->met_count = 0;
}

// Numbers a point, when the pass first meets it.
static void nsvcd__number_point(nsvcd__sorted *all, uint32_t point) {
  if (all->stamps[point] == all->pass) return;
  all->stamps[point] = all->pass;
  all->numbers[point] = (uint32_t)all->met_count;
  all->met[all->met_count++] = point;
}

// Numbers the corners of the pieces of patch i.
static void nsvcd__number_corners(nsvcd__sorted *all, size_t i) {
  nsvcd__begin_pass(all);
  for (size_t k = all->first[i]; k < all->first[i + 1]; k++) {
    const nsvcd__piece *piece = nsvcd__sorted_piece(all, k);
    const uint32_t *corners = nsvcd__piece_corners(all->pieces, piece);
    for (size_t j = 0; j < piece->count; j++) nsvcd__number_point(all, corners[j]);
  }
}

// The points of the pass, about a centre.
static nsvcd__points nsvcd__place_points(nsvcd__sorted *all, nsvcd__d3 centre) {
  const nsvcd__points out = {all->positions, all->met_count};
  for (size_t j = 0; j < all->met_count; j++) {
    const nsvcd__d3 at = nsvcd__point_at(all->pieces, all->met[j]);
    all->positions[j] = nsvcd__d3_sub(at, centre);
  }
  return out;
}

#ifndef NSVCD_NO_NETWORK
// Writes the extremes of patch i as a body stores them: (EXTREMES, 3), from its centre in steps of
// radius / 127.
static void nsvcd__extremes_of(nsvcd__sorted *all, size_t i, float radius, int8_t *extremes) {
  const double inverse = radius > 0 ? 127 / (double)radius : 0;
  nsvcd__number_corners(all, i);
  const nsvcd__d3 centre = nsvcd__d3_widen(all->pieces->patches->centres[i]);
  const nsvcd__points points = nsvcd__place_points(all, centre);
  size_t chosen[NSVCD__HULL] = {0};
  double farthest;
  const size_t count = nsvcd__choose_hull(points, NSVCD__EXTREMES, 0, all->bounds,
                                          all->nearest, chosen, &farthest);
  for (size_t k = 0; k < 3 * NSVCD__EXTREMES; k++) {
    const size_t extreme = chosen[count ? k / 3 % count : 0];
    const double along = count ? nsvcd__d3_axis(points.at[extreme], k % 3) * inverse : 0;
    extremes[k] = (int8_t)lrint(nsvcd__max(-127, nsvcd__min(along, 127)));
  }
}
#endif  // NSVCD_NO_NETWORK
#endif  // NSVCD_NO_ENCODER
