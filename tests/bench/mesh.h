// mesh.h - two methods of the benchmark: discrete checks of triangle meshes, the whole mesh
// and a simplified one.
//
// In:  a mesh in metres. Out: full_mesh_method, simplified_method (method.h).
//      "full mesh, BVH": what a user of FCL gets (Pan et al. 2012), written for speed. Reads no
//      `preparation` field. "simplified mesh, BVH": the same on a mesh whose vertices are clustered
//      on a grid, as Open3D's simplify_vertex_clustering does with the average contraction. Reads
//      preparation.detail: cells along the largest extent (the paper's voxel factor, 2..32).
//
// The tree is eight wide: an inner node keeps the boxes of its children side by side, a leaf up to
// eight triangles, and every test is one loop over eight lanes without branches, which compilers
// turn into vector code. Boxes are aligned with their own body, so that one relative rotation
// serves every pair of boxes (Gottschalk et al. 1996, the fifteen separating axes). Triangles:
// planes first (Moller 1997), then the signs of the volumes that edges span (Guigue and Devillers
// 2003). Coplanar pairs are settled by distance; touching counts, to rounding (some 1e-7 of the
// bodies' size).
//
// activation > 0 asks for distance: boxes grow by it, triangles are measured. activation < 0 is
// treated as 0: surfaces have no depth. A body wholly inside another is not seen, as in FCL. No
// start from the previous placement: a query ends at its first hit, and successive placements lie
// far apart; nothing there was worth remembering.
#ifndef NSVCD_BENCH_MESH_H
#define NSVCD_BENCH_MESH_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "method.h"

// A fused multiply-add where it is one instruction; ISO C forbids compilers to fuse on their own.
#ifdef FP_FAST_FMAF
#define MESH_BVH_FMA(a, b, c) fmaf(a, b, c)
#else
#define MESH_BVH_FMA(a, b, c) ((a) * (b) + (c))
#endif

enum { MESH_BVH_WIDTH = 8, MESH_BVH_STACK = 1024, MESH_BVH_DEEP = 12 };
#define MESH_BVH_LEAF 0x80000000u  // set in references to leaves
#define MESH_BVH_EACH(k) for (size_t k = 0; k < MESH_BVH_WIDTH; k++)

typedef struct mesh_bvh_box {
  float centre[3], half[3];
} mesh_bvh_box;

typedef struct mesh_bvh_node {
  // of the children; an unused lane never overlaps anything
  float centre[3][MESH_BVH_WIDTH], half[3][MESH_BVH_WIDTH];
  uint32_t child[MESH_BVH_WIDTH];
  mesh_bvh_box box;
  uint32_t padding[2];  // 256 bytes: whole cache lines
} mesh_bvh_node;

typedef struct mesh_bvh_leaf {
  // (corner, axis, lane); unused lanes repeat the first triangle
  float corner[3][3][MESH_BVH_WIDTH];
  float normal[3][MESH_BVH_WIDTH];  // unit
  mesh_bvh_box box;
  uint32_t count, padding;  // 416 bytes
} mesh_bvh_leaf;

typedef struct mesh_bvh {
  mesh_bvh_node *nodes;  // the root first; none if there is but one leaf
  mesh_bvh_leaf *leaves;
  mesh_bvh_box box;
  float radius;  // about the centre of the box
  size_t node_count, leaf_count, size;
} mesh_bvh;

// ----------------------------------------------------------------------------------------- helpers

static inline float mesh_bvh_min(float a, float b) {
  return a < b ? a : b;
}
static inline float mesh_bvh_max(float a, float b) {
  return a > b ? a : b;
}
static inline float mesh_bvh_clamp01(float x) {
  return mesh_bvh_min(mesh_bvh_max(x, 0), 1);
}
static inline float mesh_bvh_dot(float ax, float ay, float az, float bx, float by, float bz) {
  return MESH_BVH_FMA(ax, bx, MESH_BVH_FMA(ay, by, az * bz));
}
static inline float mesh_bvh_dot3(const float *a, const float *b) {
  return mesh_bvh_dot(a[0], a[1], a[2], b[0], b[1], b[2]);
}
static inline void mesh_bvh_cross(const float *a, const float *b, float *out) {
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3;
    int v = (i + 2) % 3;
    out[i] = a[u] * b[v] - a[v] * b[u];
  }
}
// Bit k: value[k] <= limit.
static inline unsigned mesh_bvh_mask(const float *value, float limit) {
  unsigned mask = 0;
  MESH_BVH_EACH(k) mask |= (unsigned)(value[k] <= limit) << k;
  return mask;
}
static inline const mesh_bvh_box *mesh_bvh_box_of(const mesh_bvh *tree, uint32_t at) {
  return at & MESH_BVH_LEAF ? &tree->leaves[at & ~MESH_BVH_LEAF].box : &tree->nodes[at].box;
}
static inline uint32_t mesh_bvh_root(const mesh_bvh *tree) {
  return tree->node_count ? 0 : MESH_BVH_LEAF;
}

// ------------------------------------------------------------------------------------------- build
// Splits by surface area (Wald 2007), counted in leaves of eight; a node takes the widest of its
// ranges apart until it has eight.

typedef struct mesh_bvh_triangle {
  float corner[3][3], low[3], high[3], middle[3];
} mesh_bvh_triangle;

typedef struct mesh_bvh_key {
  float value;
  uint32_t triangle;
} mesh_bvh_key;

typedef struct mesh_bvh_builder {
  mesh_bvh_triangle *triangles;
  mesh_bvh_key *keys;  // (2, triangles): the order, and a scratch copy of it
  float *areas;        // (triangles) of the boxes from the right
  size_t count;
  float slack;  // boxes are larger by this, for rounding
  mesh_bvh tree;
} mesh_bvh_builder;

typedef struct mesh_bvh_range {
  size_t begin, end;
  float area;
} mesh_bvh_range;

static int mesh_bvh_compare(const void *pa, const void *pb) {
  const mesh_bvh_key *a = (const mesh_bvh_key *)pa;
  const mesh_bvh_key *b = (const mesh_bvh_key *)pb;
  if (a->value < b->value || a->value > b->value) return a->value < b->value ? -1 : 1;
  return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}
static void mesh_bvh_grow(float *low, float *high, const mesh_bvh_triangle *t) {
  for (int i = 0; i < 3; i++) {
    low[i] = mesh_bvh_min(low[i], t->low[i]);
    high[i] = mesh_bvh_max(high[i], t->high[i]);
  }
}
static void mesh_bvh_empty(float *low, float *high) {
  for (int i = 0; i < 3; i++) {
    low[i] = FLT_MAX;
    high[i] = -FLT_MAX;
  }
}
static float mesh_bvh_area(const float *low, const float *high) {
  float x = high[0] - low[0];
  float y = high[1] - low[1];
  float z = high[2] - low[2];
  return x * y + y * z + z * x;
}
static void mesh_bvh_bounds(const mesh_bvh_builder *b, size_t begin, size_t end, float *low,
                            float *high) {
  mesh_bvh_empty(low, high);
  for (size_t i = begin; i < end; i++) mesh_bvh_grow(low, high, &b->triangles[b->keys[i].triangle]);
}
static mesh_bvh_range mesh_bvh_make_range(const mesh_bvh_builder *b, size_t begin, size_t end) {
  mesh_bvh_range range = {begin, end, 0};
  float low[3], high[3];
  mesh_bvh_bounds(b, begin, end, low, high);
  range.area = mesh_bvh_area(low, high);
  return range;
}
static void mesh_bvh_sort(mesh_bvh_builder *b, size_t begin, size_t end, int axis) {
  for (size_t i = begin; i < end; i++)
    b->keys[i].value = b->triangles[b->keys[i].triangle].middle[axis];
  qsort(b->keys + begin, end - begin, sizeof *b->keys, mesh_bvh_compare);
}
static float mesh_bvh_leaves(size_t triangles) {
  return (float)((triangles + MESH_BVH_WIDTH - 1) / MESH_BVH_WIDTH);
}

// The cheapest place to split the range, sorted along `axis`, if it costs less than *cost.
static size_t mesh_bvh_sweep(mesh_bvh_builder *b, size_t begin, size_t end, float *cost) {
  float low[3], high[3];
  size_t best = 0;
  mesh_bvh_empty(low, high);
  for (size_t i = end; i-- > begin;) {
    mesh_bvh_grow(low, high, &b->triangles[b->keys[i].triangle]);
    b->areas[i] = mesh_bvh_area(low, high);
  }
  mesh_bvh_empty(low, high);
  for (size_t i = begin; i + 1 < end; i++) {
    mesh_bvh_grow(low, high, &b->triangles[b->keys[i].triangle]);
    float c = mesh_bvh_area(low, high) * mesh_bvh_leaves(i + 1 - begin) +
              b->areas[i + 1] * mesh_bvh_leaves(end - i - 1);
    if (c < *cost) {
      *cost = c;
      best = i + 1;
    }
  }
  return best;
}
// Orders the range and returns where to cut it. Deep down it halves, which bounds the depth
// whatever the mesh.
static size_t mesh_bvh_split(mesh_bvh_builder *b, size_t begin, size_t end, int depth) {
  size_t best = 0;
  int best_axis = 0;
  float cost = FLT_MAX;
  for (int axis = 0; axis < 3; axis++) {
    mesh_bvh_sort(b, begin, end, axis);
    size_t at = mesh_bvh_sweep(b, begin, end, &cost);
    if (at) {
      best = at;
      best_axis = axis;
    }
  }
  mesh_bvh_sort(b, begin, end, best_axis);
  return best && depth < MESH_BVH_DEEP ? best : (begin + end) / 2;
}
static void mesh_bvh_set_box(const mesh_bvh_builder *b, size_t begin, size_t end,
                             mesh_bvh_box *box) {
  float low[3], high[3];
  mesh_bvh_bounds(b, begin, end, low, high);
  for (int i = 0; i < 3; i++) {
    box->centre[i] = (low[i] + high[i]) / 2;
    box->half[i] = (high[i] - low[i]) / 2 + b->slack;
  }
}
static uint32_t mesh_bvh_add_leaf(mesh_bvh_builder *b, size_t begin, size_t end) {
  mesh_bvh_leaf *leaf = &b->tree.leaves[b->tree.leaf_count];
  memset(leaf, 0, sizeof *leaf);
  leaf->count = (uint32_t)(end - begin);
  mesh_bvh_set_box(b, begin, end, &leaf->box);
  MESH_BVH_EACH(k) {
    const mesh_bvh_triangle *t =
        &b->triangles[b->keys[k < end - begin ? begin + k : begin].triangle];
    double u[3];
    double v[3];
    double n[3];
    double length = 0;
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < 3; c++) leaf->corner[c][i][k] = t->corner[c][i];
      u[i] = (double)t->corner[1][i] - (double)t->corner[0][i];
      v[i] = (double)t->corner[2][i] - (double)t->corner[0][i];
    }
    for (int i = 0; i < 3; i++) {
      n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
      length += n[i] * n[i];
    }
    for (int i = 0; i < 3; i++) leaf->normal[i][k] = (float)(n[i] / sqrt(length));
  }
  return (uint32_t)b->tree.leaf_count++ | MESH_BVH_LEAF;
}
// The widest range that does not fit a leaf, or `count`.
static size_t mesh_bvh_widest(const mesh_bvh_range *ranges, size_t count) {
  size_t widest = count;
  for (size_t i = 0; i < count; i++) {
    if (ranges[i].end - ranges[i].begin <= MESH_BVH_WIDTH) continue;
    if (widest == count || ranges[i].area > ranges[widest].area) widest = i;
  }
  return widest;
}
static uint32_t mesh_bvh_build(mesh_bvh_builder *b, size_t begin, size_t end, int depth) {
  if (end - begin <= MESH_BVH_WIDTH) return mesh_bvh_add_leaf(b, begin, end);
  mesh_bvh_range ranges[MESH_BVH_WIDTH] = {{0, 0, 0}};
  size_t count = 1;
  size_t widest;
  ranges[0] = mesh_bvh_make_range(b, begin, end);
  while (count < MESH_BVH_WIDTH && (widest = mesh_bvh_widest(ranges, count)) < count) {
    mesh_bvh_range *r = &ranges[widest];
    size_t cut = mesh_bvh_split(b, r->begin, r->end, depth);
    ranges[count++] = mesh_bvh_make_range(b, cut, r->end);
    *r = mesh_bvh_make_range(b, r->begin, cut);
  }
  uint32_t index = (uint32_t)b->tree.node_count++;
  mesh_bvh_node *node = &b->tree.nodes[index];
  memset(node, 0, sizeof *node);
  mesh_bvh_set_box(b, begin, end, &node->box);
  MESH_BVH_EACH(k) {
    mesh_bvh_box box = {{0, 0, 0}, {-1e30f, -1e30f, -1e30f}};
    if (k < count) mesh_bvh_set_box(b, ranges[k].begin, ranges[k].end, &box);
    for (int i = 0; i < 3; i++) {
      node->centre[i][k] = box.centre[i];
      node->half[i][k] = box.half[i];
    }
  }
  for (size_t k = 0; k < count; k++)
    node->child[k] = mesh_bvh_build(b, ranges[k].begin, ranges[k].end, depth + 1);
  return index;
}
// One block: the struct, the nodes, the leaves, both on cache lines.
static mesh_bvh *mesh_bvh_copy(const mesh_bvh *from) {
  size_t nodes = from->node_count * sizeof *from->nodes;
  size_t leaves = from->leaf_count * sizeof *from->leaves;
  size_t size = sizeof(mesh_bvh) + 64 + nodes + leaves;
  mesh_bvh *to = (mesh_bvh *)malloc(size);
  if (!to) return NULL;
  *to = *from;
  char *start = (char *)(to + 1);
  start += (64 - (uintptr_t)start % 64) % 64;
  to->nodes = (mesh_bvh_node *)(void *)start;
  to->leaves = (mesh_bvh_leaf *)(void *)(start + nodes);
  memcpy(to->nodes, from->nodes, nodes);
  memcpy(to->leaves, from->leaves, leaves);
  to->size = size;
  return to;
}
// Takes the triangles that have an area: what a flat one covers, its neighbours' edges cover too.
static void mesh_bvh_take(mesh_bvh_builder *b, const nsvcd_mesh *mesh) {
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    mesh_bvh_triangle *t = &b->triangles[b->count];
    float u[3], v[3], n[3];
    for (int c = 0; c < 3; c++)
      memcpy(t->corner[c], mesh->positions + 3 * (size_t)mesh->indices[3 * i + (size_t)c],
             3 * sizeof(float));
    for (int k = 0; k < 3; k++) {
      u[k] = t->corner[1][k] - t->corner[0][k];
      v[k] = t->corner[2][k] - t->corner[0][k];
      t->low[k] = mesh_bvh_min(mesh_bvh_min(t->corner[0][k], t->corner[1][k]), t->corner[2][k]);
      t->high[k] = mesh_bvh_max(mesh_bvh_max(t->corner[0][k], t->corner[1][k]), t->corner[2][k]);
      t->middle[k] = (t->low[k] + t->high[k]) / 2;
    }
    mesh_bvh_cross(u, v, n);
    float size = mesh_bvh_max(mesh_bvh_dot3(u, u), mesh_bvh_dot3(v, v));
    if (!(sqrtf(mesh_bvh_dot3(n, n)) > 1e-6f * size)) continue;
    b->keys[b->count].triangle = (uint32_t)b->count;
    b->count++;
  }
}
static float mesh_bvh_reach(const mesh_bvh_builder *b, const float *centre) {
  float most = 0;
  for (size_t i = 0; i < 3 * b->count; i++) {
    const float *x = b->triangles[i / 3].corner[i % 3];
    float d[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
    most = mesh_bvh_max(most, mesh_bvh_dot3(d, d));
  }
  return sqrtf(most);
}
static void *mesh_bvh_prepare(const nsvcd_mesh *mesh, const preparation *how) {
  (void)how;
  size_t n = mesh->triangle_count;
  mesh_bvh_builder b;
  mesh_bvh *out = NULL;
  memset(&b, 0, sizeof b);
  if (n == 0 || n >= MESH_BVH_LEAF) return NULL;
  b.triangles = (mesh_bvh_triangle *)malloc(n * sizeof *b.triangles);
  b.keys = (mesh_bvh_key *)malloc(n * sizeof *b.keys);
  b.areas = (float *)malloc(n * sizeof *b.areas);
  b.tree.nodes = (mesh_bvh_node *)malloc(n * sizeof *b.tree.nodes);
  b.tree.leaves = (mesh_bvh_leaf *)malloc(n * sizeof *b.tree.leaves);
  if (b.triangles && b.keys && b.areas && b.tree.nodes && b.tree.leaves) mesh_bvh_take(&b, mesh);
  if (b.count) {
    float low[3], high[3];
    mesh_bvh_bounds(&b, 0, b.count, low, high);
    for (int i = 0; i < 3; i++) b.slack = mesh_bvh_max(b.slack, 1e-6f * (high[i] - low[i]));
    mesh_bvh_set_box(&b, 0, b.count, &b.tree.box);
    b.tree.radius = mesh_bvh_reach(&b, b.tree.box.centre) + b.slack;
    mesh_bvh_build(&b, 0, b.count, 0);
    out = mesh_bvh_copy(&b.tree);
  }
  free(b.triangles);
  free(b.keys);
  free(b.areas);
  free(b.tree.nodes);
  free(b.tree.leaves);
  return out;
}
static void mesh_bvh_release(void *body) {
  free(body);
}
static size_t mesh_bvh_bytes(const void *body) {
  return ((const mesh_bvh *)body)->size;
}

static void mesh_bvh_scale_floats(float *x, size_t count, float scale) {
  for (size_t i = 0; i < count; i++) x[i] *= scale;
}
static void *mesh_bvh_scaled(const void *body, float scale) {
  mesh_bvh *tree = mesh_bvh_copy((const mesh_bvh *)body);
  if (!tree) return NULL;
  mesh_bvh_scale_floats(tree->box.centre, 6, scale);
  tree->radius *= scale;
  for (size_t i = 0; i < tree->node_count; i++) {
    mesh_bvh_scale_floats(tree->nodes[i].centre[0], 6 * MESH_BVH_WIDTH, scale);
    mesh_bvh_scale_floats(tree->nodes[i].box.centre, 6, scale);
  }
  for (size_t i = 0; i < tree->leaf_count; i++) {
    mesh_bvh_scale_floats(tree->leaves[i].corner[0][0], 9 * MESH_BVH_WIDTH, scale);
    mesh_bvh_scale_floats(tree->leaves[i].box.centre, 6, scale);
  }
  return tree;
}

// --------------------------------------------------------------------------------- eight box tests

typedef struct mesh_bvh_frame {  // body Y as seen from body X: x = r y + p
  float r[9], p[3];
  float m[9];  // |r|, and a little more: parallel edges span no axis, only rounding
} mesh_bvh_frame;

// gap[k] > 0: child k of a node of Y is apart from a box of X. Fifteen axes, those of edge pairs
// not normalised.
static inline void mesh_bvh_gaps(const mesh_bvh_frame *f, const mesh_bvh_box *one,
                                 const mesh_bvh_node *many, float *gap) {
  const float *r = f->r;
  const float *m = f->m;
  const float *h = one->half;
  float base[3], along[3], across[9];
  for (int i = 0; i < 3; i++) base[i] = f->p[i] - one->centre[i];
  for (int i = 0; i < 3; i++) {
    along[i] = m[i] * h[0] + m[3 + i] * h[1] + m[6 + i] * h[2];
    for (int j = 0; j < 3; j++)
      across[3 * i + j] =
          h[(i + 1) % 3] * m[(i + 2) % 3 * 3 + j] + h[(i + 2) % 3] * m[(i + 1) % 3 * 3 + j];
  }
  float d[3][MESH_BVH_WIDTH];
  const float(*b)[MESH_BVH_WIDTH] = many->half;
  MESH_BVH_EACH(k) gap[k] = -FLT_MAX;
  for (int i = 0; i < 3; i++) {
    MESH_BVH_EACH(k) {
      float c0 = many->centre[0][k];
      float c1 = many->centre[1][k];
      float c2 = many->centre[2][k];
      d[i][k] = base[i] + mesh_bvh_dot(r[3 * i], r[3 * i + 1], r[3 * i + 2], c0, c1, c2);
      float reach =
          h[i] + mesh_bvh_dot(m[3 * i], m[3 * i + 1], m[3 * i + 2], b[0][k], b[1][k], b[2][k]);
      gap[k] = mesh_bvh_max(gap[k], fabsf(d[i][k]) - reach);
    }
  }
  for (int j = 0; j < 3; j++) {
    MESH_BVH_EACH(k) {
      float along_j = mesh_bvh_dot(r[j], r[3 + j], r[6 + j], d[0][k], d[1][k], d[2][k]);
      gap[k] = mesh_bvh_max(gap[k], fabsf(along_j) - along[j] - b[j][k]);
    }
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      int i1 = (i + 1) % 3;
      int i2 = (i + 2) % 3;
      int j1 = (j + 1) % 3;
      int j2 = (j + 2) % 3;
      float r1 = r[3 * i1 + j];
      float r2 = r[3 * i2 + j];
      float m1 = m[3 * i + j1];
      float m2 = m[3 * i + j2];
      float own = across[3 * i + j];
      MESH_BVH_EACH(k) {
        float reach = MESH_BVH_FMA(b[j1][k], m2, MESH_BVH_FMA(b[j2][k], m1, own));
        gap[k] = mesh_bvh_max(gap[k], fabsf(MESH_BVH_FMA(d[i2][k], r1, -d[i1][k] * r2)) - reach);
      }
    }
}

// ------------------------------------------------------------ one triangle against those of a leaf

// A triangle in the frame of the leaf, with its unit normal.
typedef struct mesh_bvh_probe {
  float corner[3][3], normal[3];
} mesh_bvh_probe;

typedef struct mesh_bvh_heights {
  float of_leaf[3][MESH_BVH_WIDTH];  // corners of the leaf's triangles over the plane of the probe
  // corners of the probe over the planes of the leaf's triangles
  float of_probe[3][MESH_BVH_WIDTH];
} mesh_bvh_heights;

// gap[k]: a lower bound on the distance, from the two planes. thickness[k]: how far from coplanar
// they are.
static inline void mesh_bvh_planes(const mesh_bvh_probe *probe, const mesh_bvh_leaf *leaf,
                                   mesh_bvh_heights *h, float *gap, float *thickness) {
  const float *n = probe->normal;
  const float *o = probe->corner[0];
  const float(*m)[MESH_BVH_WIDTH] = leaf->normal, (*q)[MESH_BVH_WIDTH] = leaf->corner[0];
  for (int c = 0; c < 3; c++) {
    const float *p = probe->corner[c];
    const float(*x)[MESH_BVH_WIDTH] = leaf->corner[c];
    MESH_BVH_EACH(k) {
      h->of_leaf[c][k] =
          mesh_bvh_dot(n[0], n[1], n[2], x[0][k] - o[0], x[1][k] - o[1], x[2][k] - o[2]);
      h->of_probe[c][k] =
          mesh_bvh_dot(m[0][k], m[1][k], m[2][k], p[0] - q[0][k], p[1] - q[1][k], p[2] - q[2][k]);
    }
  }
  MESH_BVH_EACH(k) {
    float a0 = h->of_leaf[0][k];
    float a1 = h->of_leaf[1][k];
    float a2 = h->of_leaf[2][k];
    float b0 = h->of_probe[0][k];
    float b1 = h->of_probe[1][k];
    float b2 = h->of_probe[2][k];
    float low_a = mesh_bvh_min(mesh_bvh_min(a0, a1), a2);
    float high_a = mesh_bvh_max(mesh_bvh_max(a0, a1), a2);
    float low_b = mesh_bvh_min(mesh_bvh_min(b0, b1), b2);
    float high_b = mesh_bvh_max(mesh_bvh_max(b0, b1), b2);
    gap[k] = mesh_bvh_max(mesh_bvh_max(low_a, -high_a), mesh_bvh_max(low_b, -high_b));
    thickness[k] = mesh_bvh_min(mesh_bvh_max(-low_a, high_a), mesh_bvh_max(-low_b, high_b));
  }
}
// An edge between two heights pierces the triangle whose edges it passes with volumes v: >= 0 if
// so.
static inline float mesh_bvh_pierces(float height0, float height1, float v0, float v1, float v2) {
  float low = mesh_bvh_min(mesh_bvh_min(v0, v1), v2);
  float high = mesh_bvh_max(mesh_bvh_max(v0, v1), v2);
  float opposite = mesh_bvh_max(fabsf(height0), fabsf(height1)) > 0 ? -height0 * height1 : -1;
  return mesh_bvh_min(mesh_bvh_max(low, -high), opposite);
}
// apart[k] <= 0: an edge of one pierces the other. The volumes are products of the edges' Pluecker
// coordinates about the probe's first corner, where two of its edges have no moment.
static inline void mesh_bvh_edges(const mesh_bvh_probe *probe, const mesh_bvh_leaf *leaf,
                                  const mesh_bvh_heights *h, float *apart) {
  float a[3], b[3], n[3];
  const float *origin = probe->corner[0];
  for (int i = 0; i < 3; i++) {
    a[i] = probe->corner[1][i] - origin[i];
    b[i] = probe->corner[2][i] - origin[i];
  }
  mesh_bvh_cross(a, b, n);
  float q[3][3][MESH_BVH_WIDTH], v[3][3][MESH_BVH_WIDTH];
  for (int c = 0; c < 3; c++)
    for (int i = 0; i < 3; i++) {
      MESH_BVH_EACH(k) q[c][i][k] = leaf->corner[c][i][k] - origin[i];
    }
  for (int j = 0; j < 3; j++) {
    float(*s)[MESH_BVH_WIDTH] = q[j], (*e)[MESH_BVH_WIDTH] = q[(j + 1) % 3];
    MESH_BVH_EACH(k) {
      float mx = s[1][k] * e[2][k] - s[2][k] * e[1][k];
      float my = s[2][k] * e[0][k] - s[0][k] * e[2][k];
      float mz = s[0][k] * e[1][k] - s[1][k] * e[0][k];
      float va = mesh_bvh_dot(a[0], a[1], a[2], mx, my, mz);
      float vb = -mesh_bvh_dot(b[0], b[1], b[2], mx, my, mz);
      float turn =
          mesh_bvh_dot(n[0], n[1], n[2], e[0][k] - s[0][k], e[1][k] - s[1][k], e[2][k] - s[2][k]);
      v[0][j][k] = va;
      v[1][j][k] = turn - va - vb;
      v[2][j][k] = vb;
    }
  }
  MESH_BVH_EACH(k) apart[k] = 1;
  for (int i = 0; i < 3; i++) {
    const float *p0 = h->of_probe[i];
    const float *p1 = h->of_probe[(i + 1) % 3];
    const float *l0 = h->of_leaf[i];
    const float *l1 = h->of_leaf[(i + 1) % 3];
    MESH_BVH_EACH(k) {
      float by_probe = mesh_bvh_pierces(p0[k], p1[k], v[i][0][k], v[i][1][k], v[i][2][k]);
      float by_leaf = mesh_bvh_pierces(l0[k], l1[k], v[0][i][k], v[1][i][k], v[2][i][k]);
      apart[k] = mesh_bvh_min(apart[k], -mesh_bvh_max(by_probe, by_leaf));
    }
  }
}
// Squared distance of the segments p + s u, q + t v, by coordinates so that lanes stay lanes
// (Ericson 2005, 5.1.9).
static inline float mesh_bvh_segments(const float *p, const float *u, float uu, const float *q,
                                      const float *v) {
  float r0 = p[0] - q[0];
  float r1 = p[1] - q[1];
  float r2 = p[2] - q[2];
  float vv = mesh_bvh_dot3(v, v);
  float uv = mesh_bvh_dot3(u, v);
  float ur = mesh_bvh_dot(u[0], u[1], u[2], r0, r1, r2);
  float vr = mesh_bvh_dot(v[0], v[1], v[2], r0, r1, r2);
  float s = mesh_bvh_clamp01((uv * vr - ur * vv) / mesh_bvh_max(uu * vv - uv * uv, FLT_MIN));
  float t = mesh_bvh_clamp01((uv * s + vr) / vv);
  // best for this t: also where t was cut off, or the two are parallel
  s = mesh_bvh_clamp01((uv * t - ur) / uu);
  float x = r0 + s * u[0] - t * v[0];
  float y = r1 + s * u[1] - t * v[1];
  float z = r2 + s * u[2] - t * v[2];
  return mesh_bvh_dot(x, y, z, x, y, z);
}
// >= 0: x lies on the inner side of the edge u that starts at s, in a triangle with normal n.
static inline float mesh_bvh_side(const float *x, const float *s, const float *u, const float *n) {
  float w0 = x[0] - s[0];
  float w1 = x[1] - s[1];
  float w2 = x[2] - s[2];
  return mesh_bvh_dot(n[0], n[1], n[2], u[1] * w2 - u[2] * w1, u[2] * w0 - u[0] * w2,
                      u[0] * w1 - u[1] * w0);
}
typedef struct mesh_bvh_over {  // is a corner over the face of the other triangle? >= 0 if so
  float leaf[3][MESH_BVH_WIDTH], probe[3][MESH_BVH_WIDTH];
} mesh_bvh_over;

// Squared distances of triangles that do not intersect: edge to edge, and corners over faces.
static void mesh_bvh_distances(const mesh_bvh_probe *probe, const mesh_bvh_leaf *leaf,
                               const mesh_bvh_heights *h, float *out) {
  mesh_bvh_over over;
  MESH_BVH_EACH(k) out[k] = FLT_MAX;
  for (int i = 0; i < 3; i++) {
    MESH_BVH_EACH(k) over.leaf[i][k] = over.probe[i][k] = FLT_MAX;
  }
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {  // edge i of the probe, edge j of the leaf's triangles
      const float *p = probe->corner[i];
      const float *end = probe->corner[(i + 1) % 3];
      const float(*s)[MESH_BVH_WIDTH] = leaf->corner[j],
            (*e)[MESH_BVH_WIDTH] = leaf->corner[(j + 1) % 3];
      float u[3] = {end[0] - p[0], end[1] - p[1], end[2] - p[2]};
      float uu = mesh_bvh_dot3(u, u);
      MESH_BVH_EACH(k) {
        float q[3] = {s[0][k], s[1][k], s[2][k]};
        float v[3] = {e[0][k] - q[0], e[1][k] - q[1], e[2][k] - q[2]};
        float n[3] = {leaf->normal[0][k], leaf->normal[1][k], leaf->normal[2][k]};
        out[k] = mesh_bvh_min(out[k], mesh_bvh_segments(p, u, uu, q, v));
        over.probe[i][k] = mesh_bvh_min(over.probe[i][k], mesh_bvh_side(p, q, v, n));
        over.leaf[j][k] = mesh_bvh_min(over.leaf[j][k], mesh_bvh_side(q, p, u, probe->normal));
      }
    }
  for (int i = 0; i < 3; i++) {
    MESH_BVH_EACH(k) {
      float a = h->of_probe[i][k];
      float b = h->of_leaf[i][k];
      out[k] = mesh_bvh_min(out[k], over.probe[i][k] >= 0 ? a * a : FLT_MAX);
      out[k] = mesh_bvh_min(out[k], over.leaf[i][k] >= 0 ? b * b : FLT_MAX);
    }
  }
}
// Is a triangle of the leaf nearer than `activation`, or touching to `rounding`?
static int mesh_bvh_meets(const mesh_bvh_probe *probe, const mesh_bvh_leaf *leaf, float activation,
                          float rounding) {
  float gap[MESH_BVH_WIDTH], thickness[MESH_BVH_WIDTH], value[MESH_BVH_WIDTH];
  float limit = mesh_bvh_max(activation, rounding);
  mesh_bvh_heights h;
  mesh_bvh_planes(probe, leaf, &h, gap, thickness);
  unsigned near = mesh_bvh_mask(gap, limit);
  if (!near) return 0;
  unsigned coplanar = near & mesh_bvh_mask(thickness, rounding);
  mesh_bvh_edges(probe, leaf, &h, value);
  if (near & ~coplanar & mesh_bvh_mask(value, 0)) return 1;
  if (!(activation > 0)) near = coplanar;
  if (!near) return 0;
  mesh_bvh_distances(probe, leaf, &h, value);
  return (near & mesh_bvh_mask(value, limit * limit)) != 0;
}

// ----------------------------------------------------------------------------------------- queries

typedef struct mesh_bvh_query {
  const mesh_bvh *moving, *fixed;
  mesh_bvh_frame moving_in_fixed, fixed_in_moving;
  float activation, rounding;
} mesh_bvh_query;

static void mesh_bvh_set_frame(mesh_bvh_frame *f) {
  for (int i = 0; i < 9; i++) f->m[i] = fabsf(f->r[i]) + 1e-6f;
}
static void mesh_bvh_place(mesh_bvh_query *q, const transform *at) {
  mesh_bvh_frame *f = &q->moving_in_fixed;
  mesh_bvh_frame *g = &q->fixed_in_moving;
  memcpy(f->r, at->rotation, sizeof f->r);
  memcpy(f->p, at->position, sizeof f->p);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) g->r[3 * i + j] = f->r[3 * j + i];
    g->p[i] = -(f->r[i] * f->p[0] + f->r[3 + i] * f->p[1] + f->r[6 + i] * f->p[2]);
  }
  mesh_bvh_set_frame(f);
  mesh_bvh_set_frame(g);
}
// gap[k] > 0: triangle k, in the frame of the box, is apart from it, by the box's axes and its own
// plane.
static inline void mesh_bvh_box_gaps(const mesh_bvh_leaf *triangles, const mesh_bvh_box *box,
                                     float *gap) {
  const float(*t)[3][MESH_BVH_WIDTH] = triangles->corner, (*n)[MESH_BVH_WIDTH] = triangles->normal;
  const float *c = box->centre;
  const float *h = box->half;
  MESH_BVH_EACH(k) {
    float height = mesh_bvh_dot(n[0][k], n[1][k], n[2][k], c[0] - t[0][0][k], c[1] - t[0][1][k],
                                c[2] - t[0][2][k]);
    float reach = mesh_bvh_dot(fabsf(n[0][k]), fabsf(n[1][k]), fabsf(n[2][k]), h[0], h[1], h[2]);
    gap[k] = fabsf(height) - reach;
  }
  for (int i = 0; i < 3; i++) {
    MESH_BVH_EACH(k) {
      float low = mesh_bvh_min(mesh_bvh_min(t[0][i][k], t[1][i][k]), t[2][i][k]);
      float high = mesh_bvh_max(mesh_bvh_max(t[0][i][k], t[1][i][k]), t[2][i][k]);
      gap[k] = mesh_bvh_max(gap[k], mesh_bvh_max(low - c[i], c[i] - high) - h[i]);
    }
  }
}
static inline void mesh_bvh_move(const mesh_bvh_frame *f, const mesh_bvh_leaf *leaf,
                                 mesh_bvh_leaf *out) {
  for (int i = 0; i < 3; i++) {
    float x = f->r[3 * i];
    float y = f->r[3 * i + 1];
    float z = f->r[3 * i + 2];
    float p = f->p[i];
    for (int c = 0; c < 3; c++) {
      const float(*v)[MESH_BVH_WIDTH] = leaf->corner[c];
      MESH_BVH_EACH(k) out->corner[c][i][k] = p + mesh_bvh_dot(x, y, z, v[0][k], v[1][k], v[2][k]);
    }
    const float(*n)[MESH_BVH_WIDTH] = leaf->normal;
    MESH_BVH_EACH(k) out->normal[i][k] = mesh_bvh_dot(x, y, z, n[0][k], n[1][k], n[2][k]);
  }
}
// Brings the triangles of the wider leaf into the frame of the other, drops those that miss its
// box, and tests the rest one by one against its eight.
static int mesh_bvh_leaf_pair(const mesh_bvh_query *q, const mesh_bvh_leaf *fixed,
                              const mesh_bvh_leaf *moving) {
  int move_fixed = mesh_bvh_dot3(fixed->box.half, fixed->box.half) >
                   mesh_bvh_dot3(moving->box.half, moving->box.half);
  const mesh_bvh_leaf *wide = move_fixed ? fixed : moving;
  const mesh_bvh_leaf *other = move_fixed ? moving : fixed;
  mesh_bvh_leaf moved;
  float gap[MESH_BVH_WIDTH];
  mesh_bvh_move(move_fixed ? &q->fixed_in_moving : &q->moving_in_fixed, wide, &moved);
  mesh_bvh_box_gaps(&moved, &other->box, gap);
  unsigned mask = mesh_bvh_mask(gap, q->activation) & ((1u << wide->count) - 1);
  for (size_t k = 0; mask; k++, mask >>= 1) {
    mesh_bvh_probe probe;
    if (!(mask & 1)) continue;
    for (int i = 0; i < 3; i++) {
      probe.normal[i] = moved.normal[i][k];
      for (int c = 0; c < 3; c++) probe.corner[c][i] = moved.corner[c][i][k];
    }
    if (mesh_bvh_meets(&probe, other, q->activation, q->rounding)) return 1;
  }
  return 0;
}

typedef struct mesh_bvh_pair {
  uint32_t moving, fixed;
} mesh_bvh_pair;

// Opens the larger of two boxes and puts its children that meet the other box on the stack, the
// deepest on top.
static size_t mesh_bvh_open(const mesh_bvh_query *q, mesh_bvh_pair pair, mesh_bvh_pair *stack,
                            size_t count) {
  const mesh_bvh_box *m = mesh_bvh_box_of(q->moving, pair.moving);
  const mesh_bvh_box *f = mesh_bvh_box_of(q->fixed, pair.fixed);
  int open_fixed = !(pair.fixed & MESH_BVH_LEAF) &&
                   (pair.moving & MESH_BVH_LEAF ||
                    mesh_bvh_dot3(f->half, f->half) > mesh_bvh_dot3(m->half, m->half));
  const mesh_bvh_node *node =
      open_fixed ? &q->fixed->nodes[pair.fixed] : &q->moving->nodes[pair.moving];
  mesh_bvh_box grown = open_fixed ? *m : *f;
  float gap[MESH_BVH_WIDTH];
  float deepest = FLT_MAX;
  for (int i = 0; i < 3; i++) grown.half[i] += q->activation;
  mesh_bvh_gaps(open_fixed ? &q->fixed_in_moving : &q->moving_in_fixed, &grown, node, gap);
  unsigned mask = mesh_bvh_mask(gap, 0);
  for (size_t k = 0; mask; k++, mask >>= 1) {
    if (!(mask & 1)) continue;
    mesh_bvh_pair next = pair;
    *(open_fixed ? &next.fixed : &next.moving) = node->child[k];
    stack[count] = next;
    if (gap[k] < deepest) {
      deepest = gap[k];
    } else {
      stack[count] = stack[count - 1];
      stack[count - 1] = next;
    }
    count++;
  }
  return count;
}
// Depth first. A tree is at most MESH_BVH_DEEP + 28 nodes deep (2^31 triangles, at least halved at
// every level), and every level leaves seven pairs behind: 2 * 40 * 7 + 1 fit the stack.
static int mesh_bvh_collide(const mesh_bvh_query *q) {
  mesh_bvh_pair stack[MESH_BVH_STACK];
  size_t count = 1;
  stack[0].moving = mesh_bvh_root(q->moving);
  stack[0].fixed = mesh_bvh_root(q->fixed);
  while (count) {
    mesh_bvh_pair pair = stack[--count];
    if (!(pair.moving & pair.fixed & MESH_BVH_LEAF)) {
      count = mesh_bvh_open(q, pair, stack, count);
    } else if (mesh_bvh_leaf_pair(q, &q->fixed->leaves[pair.fixed & ~MESH_BVH_LEAF],
                                  &q->moving->leaves[pair.moving & ~MESH_BVH_LEAF])) {
      return 1;
    }
  }
  return 0;
}
// Do the bounding spheres stay apart?
static int mesh_bvh_far(const mesh_bvh *moving, const mesh_bvh *fixed, const transform *at,
                        float activation) {
  float reach = moving->radius + fixed->radius + activation;
  float sum = 0;
  for (int i = 0; i < 3; i++) {
    float d = mesh_bvh_dot3(at->rotation + 3 * i, moving->box.centre) + at->position[i] -
              fixed->box.centre[i];
    sum += d * d;
  }
  return sum > reach * reach;
}
static int mesh_bvh_hits(const void *moving, const void *fixed, const transform *at, size_t count,
                         float activation) {
  mesh_bvh_query q;
  q.moving = (const mesh_bvh *)moving;
  q.fixed = (const mesh_bvh *)fixed;
  q.activation = mesh_bvh_max(activation, 0);
  q.rounding = 2e-7f * (q.moving->radius + q.fixed->radius);
  for (size_t i = 0; i < count; i++) {
    if (mesh_bvh_far(q.moving, q.fixed, &at[i], q.activation)) continue;
    mesh_bvh_place(&q, &at[i]);
    if (mesh_bvh_collide(&q)) return 1;
  }
  return 0;
}

// ---------------------------------------------------------------------------------- simplification

typedef struct mesh_bvh_cell {
  uint64_t cell;
  uint32_t vertex;
} mesh_bvh_cell;

static int mesh_bvh_compare_cells(const void *pa, const void *pb) {
  const mesh_bvh_cell *a = (const mesh_bvh_cell *)pa;
  const mesh_bvh_cell *b = (const mesh_bvh_cell *)pb;
  if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
  return (a->vertex > b->vertex) - (a->vertex < b->vertex);
}
static int mesh_bvh_compare_corners(const void *pa, const void *pb) {
  const uint32_t *a = (const uint32_t *)pa;
  const uint32_t *b = (const uint32_t *)pb;
  for (int i = 0; i < 3; i++)
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  return 0;
}
static void mesh_bvh_mesh_bounds(const nsvcd_mesh *mesh, float *low, float *high) {
  mesh_bvh_empty(low, high);
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    const float *x = mesh->positions + 3 * (size_t)mesh->indices[i];
    for (int k = 0; k < 3; k++) {
      low[k] = mesh_bvh_min(low[k], x[k]);
      high[k] = mesh_bvh_max(high[k], x[k]);
    }
  }
}
// The cell of each vertex; Open3D's grid starts half a cell below the bounds.
static void mesh_bvh_set_cells(const nsvcd_mesh *mesh, float factor, mesh_bvh_cell *cells) {
  float low[3];
  float high[3];
  float extent = 0;
  mesh_bvh_mesh_bounds(mesh, low, high);
  for (int k = 0; k < 3; k++) extent = mesh_bvh_max(extent, high[k] - low[k]);
  double size = (double)extent / (double)factor;
  for (size_t i = 0; i < mesh->vertex_count; i++) {
    cells[i].cell = 0;
    cells[i].vertex = (uint32_t)i;
    for (size_t k = 0; k < 3; k++) {
      double at = floor(((double)mesh->positions[3 * i + k] - (double)low[k]) / size + 0.5);
      // unused vertices may lie outside
      cells[i].cell = cells[i].cell << 20 | (uint64_t)fmin(fmax(at + 1, 0), 1048575);
    }
  }
  qsort(cells, mesh->vertex_count, sizeof *cells, mesh_bvh_compare_cells);
}
// One vertex per cell, the average; renamed[i] is that of vertex i.
static void mesh_bvh_average(const nsvcd_mesh *mesh, const mesh_bvh_cell *cells, uint32_t *renamed,
                             nsvcd_mesh *out) {
  for (size_t i = 0, end; i < mesh->vertex_count; i = end) {
    double sum[3] = {0, 0, 0};
    for (end = i; end < mesh->vertex_count && cells[end].cell == cells[i].cell; end++) {
      renamed[cells[end].vertex] = (uint32_t)out->vertex_count;
      for (size_t k = 0; k < 3; k++)
        sum[k] += (double)mesh->positions[3 * (size_t)cells[end].vertex + k];
    }
    for (size_t k = 0; k < 3; k++)
      out->positions[3 * out->vertex_count + k] = (float)(sum[k] / (double)(end - i));
    out->vertex_count++;
  }
}
// Keeps triangles with three different corners, once each. Open3D keeps the same triangle wound the
// other way; for a test of surfaces it would be work without an effect, so corners are sorted and
// the winding is lost.
static void mesh_bvh_reduce(const nsvcd_mesh *mesh, const uint32_t *renamed, nsvcd_mesh *out) {
  size_t kept = 0;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    uint32_t a = renamed[mesh->indices[3 * i]];
    uint32_t b = renamed[mesh->indices[3 * i + 1]];
    uint32_t c = renamed[mesh->indices[3 * i + 2]];
    uint32_t *t = out->indices + 3 * out->triangle_count;
    if (a == b || b == c || c == a) continue;
    uint32_t low = a < b ? (a < c ? a : c) : (b < c ? b : c);
    uint32_t high = a > b ? (a > c ? a : c) : (b > c ? b : c);
    t[0] = low;
    t[1] = a ^ b ^ c ^ low ^ high;
    t[2] = high;
    out->triangle_count++;
  }
  qsort(out->indices, out->triangle_count, 3 * sizeof(uint32_t), mesh_bvh_compare_corners);
  for (size_t i = 0; i < out->triangle_count; i++) {
    uint32_t *t = out->indices + 3 * i;
    if (i && memcmp(t, t - 3, 3 * sizeof *t) == 0) continue;
    memmove(out->indices + 3 * kept++, t, 3 * sizeof *t);
  }
  out->triangle_count = kept;
}
// The bounding box's twelve triangles; a flat one has fewer with an area.
static void *mesh_bvh_prepare_box(const nsvcd_mesh *mesh) {
  static const uint32_t faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  float low[3], high[3], positions[24];
  uint32_t indices[36];
  nsvcd_mesh box;
  mesh_bvh_mesh_bounds(mesh, low, high);
  for (int i = 0; i < 24; i++) positions[i] = (i / 3 >> i % 3) & 1 ? high[i % 3] : low[i % 3];
  memcpy(indices, faces, sizeof indices);
  memset(&box, 0, sizeof box);
  box.positions = positions;
  box.indices = indices;
  box.vertex_count = 8;
  box.triangle_count = 12;
  return mesh_bvh_prepare(&box, NULL);
}
static void *mesh_bvh_prepare_simplified(const nsvcd_mesh *mesh, const preparation *how) {
  size_t n = mesh->vertex_count;
  if (n == 0 || mesh->triangle_count == 0) return NULL;
  nsvcd_mesh out;
  memset(&out, 0, sizeof out);
  mesh_bvh_cell *cells = (mesh_bvh_cell *)malloc(n * sizeof *cells);
  uint32_t *renamed = (uint32_t *)malloc(n * sizeof *renamed);
  out.positions = (float *)malloc(3 * n * sizeof(float));
  out.indices = (uint32_t *)malloc(3 * mesh->triangle_count * sizeof(uint32_t));
  void *body = NULL;
  if (cells && renamed && out.positions && out.indices) {
    mesh_bvh_set_cells(mesh, mesh_bvh_max(how->detail, 1), cells);
    mesh_bvh_average(mesh, cells, renamed, &out);
    mesh_bvh_reduce(mesh, renamed, &out);
    body = out.triangle_count ? mesh_bvh_prepare(&out, NULL) : NULL;
    if (!body) body = mesh_bvh_prepare_box(mesh);
  }
  free(cells);
  free(renamed);
  free(out.positions);
  free(out.indices);
  return body;
}

static const method full_mesh_method = {"full mesh, BVH", mesh_bvh_prepare, mesh_bvh_scaled,
                                        mesh_bvh_release, mesh_bvh_bytes,   mesh_bvh_hits};
static const method simplified_method = {"simplified mesh, BVH", mesh_bvh_prepare_simplified,
                                         mesh_bvh_scaled,        mesh_bvh_release,
                                         mesh_bvh_bytes,         mesh_bvh_hits};

#endif  // NSVCD_BENCH_MESH_H
