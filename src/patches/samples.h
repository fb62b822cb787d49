// In: a checked mesh. Out: S samples, oriented points of its surface; and what its N patches are
// stored in: samples grouped by patch, and a ball for each patch. Everything in patches/ is
// deterministic and, up to rounding, scales and moves with the mesh.
#pragma once
#include "../ground/memory.h"

#ifndef NSVCD_NO_ENCODER
// the mean
#define NSVCD__SAMPLES_PER_PATCH 32
#define NSVCD__LLOYD_STEPS 3
// of each centre, to search for the nearest one
#define NSVCD__NEIGHBOURS 16
// longest edge of a piece, in mean sample radii
#define NSVCD__PIECE_SIZE 0.25
// limits the pieces that halving adds
#define NSVCD__PIECES_PER_SAMPLE 64

// Sums over a patch, in double, rounded once at the end.
typedef struct nsvcd__patch_sum {
  // of positions of samples, or of area vectors
  nsvcd__d3 vector;
  double weight;  // number of samples
  // the greatest squared distance from the centre
  double greatest;
} nsvcd__patch_sum;

typedef struct nsvcd__patches {
  size_t count;         // N
  size_t sample_count;  // S
  // (N) metres: the mean of the patch's samples
  nsvcd__f3 *centres;
  // (N) metres: the ball about the centre contains the patch's samples
  float *sample_radii;

  // For latents only.
  // triangles and parts of them that the balls were fitted to
  size_t piece_count;
  // (N) metres: the ball about the centre contains the patch's pieces
  float *radii;
  // (N) sums of area times normal; their sum is the mesh's
  nsvcd__f3 *area_vectors;
  // (N + 1) patch i has the samples offsets[i] .. offsets[i + 1] - 1
  uint32_t *offsets;
  nsvcd__f3 *samples;  // (S) metres
  nsvcd__f3 *normals;  // (S) unit

  // Working memory.
  nsvcd__patch_sum *sums;  // (N)
  // (S) the samples in the order in which they were drawn
  nsvcd__f3 *drawn, *drawn_normals;
  // (S) the patch of each
  uint16_t *owners;
  // (S) squared distance from the owner's centre; in the memory of `samples`
  float *squares;
  // (2 S) lists of each centre's samples, centre by centre, with gaps; in the memory of `samples`
  uint32_t *lists;
  // (N) where a centre's list begins, and how long it is
  uint32_t *first_sample, *held;
  // 1: neighbours are listed
  int linked;
  // (N) each centre's farthest sample, and its squared distance; then working memory
  uint32_t *farthest_sample;
  float *greatest;
  // (N, NEIGHBOURS) the nearest other centres, nearest first, and a quarter of their squared
  // distance
  uint32_t *neighbours;
  float *quarter_squares;
} nsvcd__patches;

// ---- samples

// In double: differences of floats are next to exact.
typedef struct nsvcd__triangle {
  nsvcd__d3 at[3];
} nsvcd__triangle;

static nsvcd__triangle nsvcd__triangle_of(const nsvcd_mesh *mesh, size_t t) {
  const float *from = mesh->positions;
  const uint32_t *i = mesh->indices + 3 * t;
  const nsvcd__triangle out = {
      {nsvcd__d3_row(from, i[0]), nsvcd__d3_row(from, i[1]), nsvcd__d3_row(from, i[2])}};
  return out;
}

// Area times unit normal.
static nsvcd__d3 nsvcd__area_vector(const nsvcd__triangle *t) {
  const nsvcd__d3 u = nsvcd__d3_sub(t->at[1], t->at[0]);
  const nsvcd__d3 v = nsvcd__d3_sub(t->at[2], t->at[0]);
  return nsvcd__d3_scale(nsvcd__d3_cross(u, v), 0.5);
}

static double nsvcd__triangle_area(const nsvcd__triangle *t) {
  return nsvcd__d3_norm(nsvcd__area_vector(t));
}

static double nsvcd__mesh_area(const nsvcd_mesh *mesh) {
  double area = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const nsvcd__triangle triangle = nsvcd__triangle_of(mesh, t);
    area += nsvcd__triangle_area(&triangle);
  }
  return area;
}

// Draws samples (count) and their unit normals (count), stratified by area: sample k lies in the
// triangle where the area, summed in triangle order, passes (k + 1/2) / count of the total. Its
// position there comes from the R2 sequence (Roberts 2018: multiples of 1/g and 1/g^2, g^3 = g +
// 1). Without any area, triangles have equal weights and normals are 0. normals: or NULL.
static void nsvcd__sample_surface(const nsvcd_mesh *mesh, size_t count, nsvcd__f3 *samples,
                                  nsvcd__f3 *normals) {
  const double all = nsvcd__mesh_area(mesh);
  const double total = all > 0 ? all : (double)mesh->triangle_count;
  nsvcd__triangle triangle;
  double area = 0;
  // the area up to this triangle, which is included
  double passed = 0;
  size_t next = 0;
  for (size_t k = 0; k < count; k++) {
    const double target = total * (((double)k + 0.5) / (double)count);
    // this never stops at a triangle without area
    while (passed <= target && next < mesh->triangle_count) {
      triangle = nsvcd__triangle_of(mesh, next++);
      area = nsvcd__triangle_area(&triangle);
      passed += all > 0 ? area : 1;
    }
    double u = (double)((uint32_t)k * 3242174889u + 0x80000000u) / 4294967296.0;
    double v = (double)((uint32_t)k * 2447445414u + 0x80000000u) / 4294967296.0;
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const nsvcd__d3 ab = nsvcd__d3_sub(triangle.at[1], triangle.at[0]);
    const nsvcd__d3 ac = nsvcd__d3_sub(triangle.at[2], triangle.at[0]);
    const nsvcd__d3 along = nsvcd__d3_fma(u, ab, triangle.at[0]);
    samples[k] = nsvcd__d3_narrow(nsvcd__d3_fma(v, ac, along));
    if (!normals) continue;
    normals[k] = nsvcd__f3_of(0, 0, 0);
    if (area > 0)
      normals[k] = nsvcd__d3_narrow(nsvcd__d3_over(nsvcd__area_vector(&triangle), area));
  }
}

// Makes room for patches and samples. latents: 1: for what these need, too. 0 without memory.
static int nsvcd__patches_alloc(nsvcd__patches *p, size_t count, size_t samples, int latents,
                                nsvcd__arena *arena) {
  const size_t links = NSVCD__NEIGHBOURS * count;
  memset(p, 0, sizeof *p);
  p->count = count;
  p->sample_count = samples;
  p->sums = NSVCD__TAKE(arena, nsvcd__patch_sum, count);
  p->centres = NSVCD__TAKE(arena, nsvcd__f3, count);
  p->sample_radii = NSVCD__TAKE(arena, float, count);
  p->drawn = NSVCD__TAKE(arena, nsvcd__f3, samples);
  p->samples = NSVCD__TAKE(arena, nsvcd__f3, samples);
  p->quarter_squares = NSVCD__TAKE(arena, float, links);
  p->greatest = NSVCD__TAKE(arena, float, count);
  p->first_sample = NSVCD__TAKE(arena, uint32_t, count);
  p->held = NSVCD__TAKE(arena, uint32_t, count);
  p->farthest_sample = NSVCD__TAKE(arena, uint32_t, count);
  p->neighbours = NSVCD__TAKE(arena, uint32_t, links);
  p->offsets = NSVCD__TAKE(arena, uint32_t, count + 1);
  p->owners = NSVCD__TAKE(arena, uint16_t, samples);
  if (latents) {
    p->radii = NSVCD__TAKE(arena, float, count);
    p->area_vectors = NSVCD__TAKE(arena, nsvcd__f3, count);
    p->drawn_normals = NSVCD__TAKE(arena, nsvcd__f3, samples);
    p->normals = NSVCD__TAKE(arena, nsvcd__f3, samples);
  }
  if (arena->failed) return 0;
  p->squares = (float *)(void *)p->samples;
  p->lists = (uint32_t *)(void *)(p->squares + samples);
  return 1;
}
#endif  // NSVCD_NO_ENCODER
