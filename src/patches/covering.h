// In: centres, their samples, and the mesh. Out: for latents a ball for each patch; together they
// contain every triangle.
//
// Triangles are halved across their longest edges until no edge exceeds `limit`. Each half goes to
// the patch whose centre is nearest to its centroid, and that patch's ball grows to contain its
// three corners, and so all of it.
#pragma once
#include "clusters.h"

#ifndef NSVCD_NO_ENCODER
// The squared lengths of a triangle's edges, each from a corner to the next. Returns which is the
// longest; of equals the first.
static inline size_t nsvcd__edge_squares(const nsvcd__triangle *t, double *e) {
  for (size_t k = 0; k < 3; k++)
    e[k] = nsvcd__d3_distance2(t->at[k], t->at[k == 2 ? 0 : k + 1]);
  return nsvcd__d3_longest(nsvcd__d3_of(e[0], e[1], e[2]));
}

// How many halves a triangle makes; stops counting beyond `most`. The new edge is the median of the
// longest one (Apollonius's theorem), so lengths are all that it takes.
static double nsvcd__count_pieces(const double *e, double limit, double most) {
  const size_t k = nsvcd__d3_longest(nsvcd__d3_of(e[0], e[1], e[2]));
  const size_t next = k == 2 ? 0 : k + 1;
  const double ab = e[k];
  const double bc = e[next];
  const double ca = e[3 - k - next];
  if (ab <= limit * limit) return 1;
  const double median = 0.5 * (bc + ca) - 0.25 * ab;
  const double near_a[3] = {0.25 * ab, median, ca};
  const double near_b[3] = {0.25 * ab, bc, median};
  const double pieces = nsvcd__count_pieces(near_a, limit, most);
  if (pieces > most) return pieces;
  return pieces + nsvcd__count_pieces(near_b, limit, most - pieces);
}

// Doubles the limit on edges until a mesh makes at most `most` halves. Writes how many.
static double nsvcd__raise_limit(const nsvcd_mesh *mesh, double limit, double most,
                                 double *pieces) {
  // A triangle makes at least as many halves as its longest edge is limits long, so no lower limit
  // can do.
  double longest = 0;
  double e[3];
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
    const size_t k = nsvcd__edge_squares(&triangle, e);
    longest = nsvcd__max(longest, e[k]);
  }
  for (limit = nsvcd__max(limit, sqrt(longest) / most);; limit *= 2) {
    *pieces = 0;
    for (size_t t = 0; t < mesh->triangle_count && *pieces <= most; t++) {
      const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
      (void)nsvcd__edge_squares(&triangle, e);
      *pieces += nsvcd__count_pieces(e, limit, most - *pieces);
    }
    if (*pieces <= most) return limit;
  }
}

// Halves a triangle until its edges are short, and gives each half to the patch with the nearest
// centre. vector: area times normal. guess: a patch near by. Returns the last half's patch, which
// is a guess for the next triangle.
static uint32_t nsvcd__cover_triangle(nsvcd__patches *p, double limit, uint32_t guess,
                                      const nsvcd__triangle *t, nsvcd__d3 vector) {
  double e[3];
  const size_t k = nsvcd__edge_squares(t, e);
  const size_t next = k == 2 ? 0 : k + 1;
  const nsvcd__d3 a = t->at[k];
  const nsvcd__d3 b = t->at[next];
  const nsvcd__d3 c = t->at[3 - k - next];
  if (e[k] <= limit * limit) {
    const nsvcd__d3 sum = nsvcd__d3_add(nsvcd__d3_add(a, b), c);
    const nsvcd__f3 centroid = nsvcd__d3_narrow(nsvcd__d3_over(sum, 3));
    const uint32_t patch = nsvcd__nearest_centre(p, guess, centroid);
    p->sums[patch].vector = nsvcd__d3_add(p->sums[patch].vector, vector);
    for (size_t i = 0; i < 3; i++) nsvcd__extend(p, patch, t->at[i]);
    p->piece_count++;
    return patch;
  }
  const nsvcd__d3 middle = nsvcd__d3_scale(nsvcd__d3_add(a, b), 0.5);
  const nsvcd__triangle near_a = {{a, middle, c}};
  const nsvcd__triangle near_b = {{middle, b, c}};
  vector = nsvcd__d3_scale(vector, 0.5);
  guess = nsvcd__cover_triangle(p, limit, guess, &near_a, vector);
  return nsvcd__cover_triangle(p, limit, guess, &near_b, vector);
}

static void nsvcd__cover(nsvcd__patches *p, const nsvcd_mesh *mesh) {
  const double added = NSVCD__PIECES_PER_SAMPLE * (double)p->sample_count;
  const double most = (double)mesh->triangle_count + added;
  double pieces;
  // a limit that is too high only makes balls larger
  double limit = 0;
  for (size_t i = 0; i < p->count; i++) limit += (double)p->sample_radii[i] / (double)p->count;
  limit *= NSVCD__PIECE_SIZE;
  // 0: all samples of each patch coincide
  limit = limit > 0 ? nsvcd__raise_limit(mesh, limit, most, &pieces) : HUGE_VAL;

  uint32_t guess = 0;
  memset(p->sums, 0, p->count * sizeof *p->sums);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
    const nsvcd__d3 vector = nsvcd__area_vector(&triangle);
    guess = nsvcd__cover_triangle(p, limit, guess, &triangle, vector);
  }
  for (size_t i = 0; i < p->count; i++) {
    const nsvcd__patch_sum *sum = &p->sums[i];
    // Samples may lie outside of the halves that their patch was given: the ball contains both.
    const float radius = nsvcd__radius_above(sum->greatest);
    p->radii[i] = fmaxf(radius, p->sample_radii[i]);
    p->area_vectors[i] = nsvcd__d3_narrow(sum->vector);
  }
}

// ---- all of it

// Splits the surface of a checked mesh into at most `count` patches, 1..NSVCD_SMALL_PATCHES: fewer
// if samples coincide, or a patch loses all of its own. latents: 1: finds what only these need.
// MEMORY.
static nsvcd_result nsvcd__patches_build(const nsvcd_mesh *mesh, size_t count, int latents,
                                         nsvcd__arena *arena, nsvcd__patches *p) {
  const size_t samples = NSVCD__SAMPLES_PER_PATCH * count;
  if (!nsvcd__patches_alloc(p, count, samples, latents, arena)) return NSVCD_ERROR_MEMORY;
  nsvcd__sample_surface(mesh, p->sample_count, p->drawn, p->drawn_normals);
  nsvcd__farthest_points(p);
  nsvcd__move_centres(p);
  for (int step = 1; step < NSVCD__LLOYD_STEPS; step++) {
    for (size_t s = 0; s < p->sample_count; s++)
      p->owners[s] = (uint16_t)nsvcd__nearest_centre(p, p->owners[s], p->drawn[s]);
    nsvcd__move_centres(p);
  }
  nsvcd__measure_samples(p);
  if (latents) nsvcd__group_samples(p);
  if (latents) nsvcd__cover(p, mesh);
  return NSVCD_OK;
}
#endif  // NSVCD_NO_ENCODER
