// In: a body of triangles. Out: what it begins with: counts, its box, and the balls that cover it,
// which looks read, and nothing else. body/geometry says where they stand.
#pragma once
#include "body.h"

#define NSVCD__GEOMETRY_BOX 8  // floats of `box` and `widest`

typedef struct nsvcd__counts {
  // L, entries of all patches
  uint32_t listed;
  // V, stored points
  uint32_t vertices;
  uint32_t components;   // C
  uint32_t entry_bytes;  // B
  // metres that the body extends beyond its triangles
  float convex_radius;
  // W, R, K; all 0: the body is coarse
  uint32_t positions, references, cut;
  // as nsvcd_body_facts tells them
  uint32_t solids, open_solids, open_edges;
  // 1: entries have kinds of two bits
  uint32_t is_mixed;
  // metres: corners this near count as one in what is closed
  float gap;
  // balls that cover the mesh; metres: no point of them is farther from the solid
  uint32_t balls;
  float ball_error;
  // 1: the mesh is a box along the axes, solid
  uint32_t is_box;
} nsvcd__counts;

// The body of triangles in a body; NULL: there is none, or it may not be read.
static const nsvcd_body *nsvcd__triangles_of(const nsvcd_body *body) {
  if (!NSVCD__PROOF || body->triangles == 0) return NULL;
  return (const nsvcd_body *)(const void *)((const char *)body + body->inner);
}

static const nsvcd__counts *nsvcd__counts_of(const nsvcd_body *body) {
  const char *at = (const char *)body + nsvcd__spheres_size(body->padded);
  return (const nsvcd__counts *)(const void *)at;
}

// Balls, rounded up to 16, and the spheres over 16 of them each, rounded up again.
static size_t nsvcd__ball_slots(const nsvcd__counts *counts) {
  const size_t slots = nsvcd__round_up(counts->balls, NSVCD__GROUP);
  return slots + nsvcd__group_slots(slots);
}

typedef struct nsvcd__covering {
  const nsvcd__counts *counts;
  // (2, 3), as in the body
  const float *box;
  nsvcd__spheres balls, clusters;
  // slots of these
  size_t ball_slots, cluster_slots;
  // (6, P): of the patches
  const float *slabs;
} nsvcd__covering;

static nsvcd__covering nsvcd__covering_of(const nsvcd_body *body) {
  nsvcd__covering out;
  out.counts = nsvcd__counts_of(body);
  out.box = (const float *)(out.counts + 1);
  out.ball_slots = nsvcd__round_up(out.counts->balls, NSVCD__GROUP);
  out.cluster_slots = nsvcd__group_slots(out.ball_slots);
  const float *balls = out.box + NSVCD__GEOMETRY_BOX;
  out.balls = nsvcd__spheres_of(balls, out.ball_slots);
  out.clusters = nsvcd__spheres_of(balls + 4 * out.ball_slots, out.cluster_slots);
  out.slabs = balls + 4 * nsvcd__ball_slots(out.counts);
  return out;
}
