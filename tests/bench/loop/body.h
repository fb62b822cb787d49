// body.h - a mesh as a tree of 16: what the proof knows of a body.
// In: a mesh. Out: one blob, `tree_body`, of nodes (16 children: a box, a slab, how far they reach)
// and leaves (16 triangles or parts of them). Coordinates are about the middle of the mesh's box.
//
// ROUNDING, outwards. A leaf's corners are on a lattice whose step is a power of two, so what is
// read is exactly what was stored, and no corner is farther than `leaf_error` (0.867 steps) from
// the true one; a triangle or a part of one is then as near to the stored one, for both are convex
// hulls of their corners. Boxes and slabs of nodes hold the TRUE triangles: they are taken of the
// unrounded corners, in double, and rounded outwards to whole steps of the node's quantum. So only
// tests of leaves' triangles need to allow for the error. Reading a box or a slab rounds once in
// float, which is in what a span allows for all its float computations (motion.h).
#ifndef LOOP_BODY_H
#define LOOP_BODY_H

#include "lanes.h"

#define LEAF_LINK 0x80000000u  // of a link: it leads to a leaf
#define LOOSE 48               // vertices of a leaf that shares none: corner k of lane l is 16 k + l
#define MOST_SHARED 32
#define NODE_STEPS 32766.0

// Links and the like count words of 4 bytes from the start of the blob.
typedef struct tree_node {
  float middle[3], quantum;
  uint32_t links[LANES];  // of children
  uint32_t count;
  int16_t low[3][LANES], high[3][LANES];  // quanta from the middle
  int16_t normal[3][LANES];               // of the slab, over 32767: not longer than 1
  int16_t slab[2][LANES];                 // its least and greatest offset, double quanta
  uint16_t reach[LANES];                  // in units of the body's reach_unit
} tree_node;

// Followed by numbers of the mesh's triangles (count; 2 bytes each, or 4 where the body has more
// than 65536), then by lattice coordinates, (3, vertices) of 2 bytes.
typedef struct tree_leaf {
  float origin[3], step;
  uint8_t count, vertices;  // vertices: up to MOST_SHARED, or LOOSE
  uint16_t closed;          // lanes whose triangle belongs to a closed component
  uint16_t corners[LANES];  // three vertices of 5 bits, the first one lowest
} tree_leaf;

typedef struct tree_body {
  uint32_t bytes, triangles, pieces, nodes, leaves, depth;
  uint32_t wide_numbers;
  uint32_t top;  // a node of one child, which holds everything
  uint32_t seeds, seed_count;  // a vertex of each component, 3 floats
  float centre[3];             // where the middle is in the mesh's coordinates
  float off;                   // its distance from there
  float reach;                 // of the farthest point from the middle
  float reach_unit;
  float quantum;               // the worst leaf_error
  float low[3], high[3];       // of everything
  int32_t open;                // no component is closed
  uint32_t padding;
} tree_body;

// A place in the tree: a node, and which of its children.
FAST uint32_t place_of(uint32_t node, uint32_t slot) {
  return node << 4 | slot;
}
FAST const void *body_at(const tree_body *b, uint32_t word) {
  return (const uint32_t *)(const void *)b + word;
}
FAST const tree_node *node_at(const tree_body *b, uint32_t word) {
  return (const tree_node *)body_at(b, word);
}
FAST float leaf_error(const tree_leaf *leaf) {
  return 0.867f * leaf->step;
}

// One child, read.
typedef struct tree_child {
  float centre[3], half[3];
  float normal[3], slab[2];
  float reach;  // farthest distance from the body's middle
  float size;   // half the box's diagonal
  uint32_t link;
} tree_child;

static inline tree_child child_at(const tree_body *b, uint32_t place) {
  const tree_node *node = node_at(b, place >> 4);
  const uint32_t l = place & 15;
  tree_child c;
  float square = 0;
  float along = 0;
  for (int k = 0; k < 3; k++) {
    const float low = (float)node->low[k][l];
    const float high = (float)node->high[k][l];
    c.centre[k] = node->middle[k] + 0.5f * node->quantum * (low + high);
    c.half[k] = 0.5f * node->quantum * (high - low);
    c.normal[k] = (float)node->normal[k][l] * (1 / 32767.0f);
    square += c.half[k] * c.half[k];
    along += c.normal[k] * node->middle[k];
  }
  c.slab[0] = along + 2 * node->quantum * (float)node->slab[0][l];
  c.slab[1] = along + 2 * node->quantum * (float)node->slab[1][l];
  c.reach = b->reach_unit * (float)node->reach[l];
  c.size = sqrtf(square);
  c.link = node->links[l];
  return c;
}

// 16 children, read.
typedef struct tree_children {
  lanes3 low, high, normal;
  lanes slab_low, slab_high, reach;
  uint32_t there;  // lanes
} tree_children;

FAST lanes3 node_places(const tree_node *node, const int16_t (*rows)[LANES]) {
  const lanes step = lanes_set(node->quantum);
  return (lanes3){node->middle[0] + step * lanes_signed(rows[0]),
                  node->middle[1] + step * lanes_signed(rows[1]),
                  node->middle[2] + step * lanes_signed(rows[2])};
}
FAST tree_children children_of(const tree_body *b, const tree_node *node) {
  tree_children c;
  const lanes unit = lanes_set(1 / 32767.0f);
  const lanes step = lanes_set(2 * node->quantum);
  const lanes3 middle = lanes3_set(node->middle[0], node->middle[1], node->middle[2]);
  c.low = node_places(node, node->low);
  c.high = node_places(node, node->high);
  c.normal = (lanes3){unit * lanes_signed(node->normal[0]), unit * lanes_signed(node->normal[1]),
                      unit * lanes_signed(node->normal[2])};
  const lanes along = lanes3_dot(c.normal, middle);
  c.slab_low = along + step * lanes_signed(node->slab[0]);
  c.slab_high = along + step * lanes_signed(node->slab[1]);
  c.reach = lanes_set(b->reach_unit) * lanes_unsigned(node->reach);
  c.there = first_lanes(node->count);
  return c;
}

// A leaf's distinct vertices, 16 at a time, or its corners where it is loose.
typedef struct leaf_points {
  lanes3 at[3];
  int sets;  // of 16
} leaf_points;

FAST const uint8_t *leaf_numbers(const tree_leaf *leaf) {
  return (const uint8_t *)(leaf + 1);
}
FAST const uint16_t *leaf_lattice(const tree_body *b, const tree_leaf *leaf) {
  return (const uint16_t *)(const void *)(leaf_numbers(leaf) +
                                          leaf->count * (b->wide_numbers ? 4u : 2u));
}
static inline uint32_t leaf_number(const tree_body *b, const tree_leaf *leaf, unsigned lane) {
  uint32_t number = 0;
  const size_t size = b->wide_numbers ? 4 : 2;
  memcpy(&number, leaf_numbers(leaf) + lane * size, size);
  return number;  // little-endian
}
FAST void leaf_read(const tree_body *b, const tree_leaf *leaf, leaf_points *out) {
  const uint16_t *x = leaf_lattice(b, leaf);
  const uint32_t n = leaf->vertices;
  const lanes step = lanes_set(leaf->step);
  out->sets = (int)(n + LANES - 1) / LANES;
  for (int s = 0; s < 3; s++) {
    if (s >= out->sets)
      break;
    out->at[s].x = leaf->origin[0] + step * lanes_unsigned(x + LANES * s);
    out->at[s].y = leaf->origin[1] + step * lanes_unsigned(x + n + LANES * s);
    out->at[s].z = leaf->origin[2] + step * lanes_unsigned(x + 2 * n + LANES * s);
  }
}
// 16 triangles' corners; each may have been posed since it was read.
FAST void leaf_corners(const tree_leaf *leaf, const leaf_points *points, lanes3 *corners) {
  if (points->sets == 3) {
    for (int k = 0; k < 3; k++)
      corners[k] = points->at[k];
    return;
  }
  const lanes3 low = points->at[0];
  const lanes3 high = points->sets > 1 ? points->at[1] : low;
  for (int k = 0; k < 3; k++) {
    corners[k].x = lanes_chosen(low.x, high.x, leaf->corners, 5 * k);
    corners[k].y = lanes_chosen(low.y, high.y, leaf->corners, 5 * k);
    corners[k].z = lanes_chosen(low.z, high.z, leaf->corners, 5 * k);
  }
}
// One triangle, in double: exactly as stored.
static inline void leaf_triangle(const tree_body *b, const tree_leaf *leaf, unsigned lane,
                                 nsvcd__d3 *out) {
  const uint16_t *x = leaf_lattice(b, leaf);
  const uint32_t n = leaf->vertices;
  const double step = (double)leaf->step;
  for (unsigned k = 0; k < 3; k++) {
    const unsigned v = n == LOOSE ? LANES * k + lane : leaf->corners[lane] >> 5 * k & 31u;
    out[k].x = (double)leaf->origin[0] + step * x[v];
    out[k].y = (double)leaf->origin[1] + step * x[n + v];
    out[k].z = (double)leaf->origin[2] + step * x[2 * n + v];
  }
}

#endif
