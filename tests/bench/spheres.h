// spheres.h - a method of the benchmark: the moving body as spheres, the fixed one as a mesh
// to measure from.
//
// In:  a mesh in metres. Out: spheres_method (method.h). Reads preparation.detail: the voxel's edge
//      in metres (the paper's 0.01..1), and preparation.points: spheres on the surface (0..100 there). Sources:
//      cuRobo (Sundaralingam et al. 2023, fit type voxel_volume_sample_surface) and appendix B of
//      the NeuralSVCD paper.
//
// Spheres. One in every voxel whose centre is inside the mesh, with the clearance of that centre as
// its radius: all of it is inside, so that it adds no false alarm, and it covers at least what
// cuRobo's radius of half a voxel does (which also drops the centres nearer to the surface than
// that). Those that another one contains, but for a tenth of a voxel, are dropped: they cost time
// and find nothing. The points are spread evenly over the area and have cuRobo's radius for
// attached objects, 2 mm. If there is no sphere at all (no voxel inside, no points): 16 points, as
// cuRobo falls back to.
//
// Query. A sphere hits where the signed distance of its centre from the fixed mesh is below radius
// + activation (also if that is negative). Three means, all exact, so that only the time depends on
// them: a tree of bounding spheres; a coarse grid of signed distances at cell centres, which bounds
// the distance elsewhere by the triangle inequality and settles most spheres; and, for those that
// are left, the mesh's tree (mesh.h), once for a triangle within reach, and, where none is
// and the grid cannot say, once for the sign. The sign is that of the winding number along a ray
// (bodies may be unions of overlapping closed parts, so parity or pseudo-normals would lie; an open
// mesh has no inside, and gets an arbitrary one). A query ends at its first hit: there is no sphere
// that hit last to begin with.
//
// Both roles are prepared at once, and `bytes` counts both: spheres and their tree; mesh tree and
// grid.
#ifndef NSVCD_BENCH_SPHERES_H
#define NSVCD_BENCH_SPHERES_H

#include "mesh.h"

enum {
  SPHERES_CELLS = 24,
  SPHERES_GROUP = 4,
  SPHERES_FALLBACK = 16,
  SPHERES_MOST_VOXELS = 1 << 22
};
#define SPHERES_SURFACE_RADIUS 0.002f

typedef struct spheres_ball {
  float centre[3], radius;
} spheres_ball;

typedef struct spheres_node {  // in depth-first order
  spheres_ball ball;           // contains all balls of the node
  uint32_t first, count;       // balls; count 0: an inner node
  uint32_t next;               // the node after all below this one
} spheres_node;

typedef struct spheres_grid {
  float low[3], cell, inverse;
  size_t size[3];
  float *distance;  // (size[2], size[1], size[0]) signed, of the cells' centres, negative inside
} spheres_grid;

typedef struct spheres_body {
  mesh_bvh *tree;
  spheres_grid grid;
  spheres_ball *balls;
  spheres_node *nodes;
  size_t ball_count, node_count, ball_capacity;
} spheres_body;

// ---------------------------------------------------------------------------------- point and mesh

typedef struct spheres_entry {
  uint32_t at;
  float distance;  // squared, of the box
} spheres_entry;

static inline void spheres_to_boxes(const mesh_bvh_node *node, const float *x, float *out) {
  MESH_BVH_EACH(k) {
    float a = mesh_bvh_max(fabsf(x[0] - node->centre[0][k]) - node->half[0][k], 0);
    float b = mesh_bvh_max(fabsf(x[1] - node->centre[1][k]) - node->half[1][k], 0);
    float c = mesh_bvh_max(fabsf(x[2] - node->centre[2][k]) - node->half[2][k], 0);
    out[k] = mesh_bvh_dot(a, b, c, a, b, c);
  }
}
static inline void spheres_to_triangles(const mesh_bvh_leaf *leaf, const float *x, float *out) {
  float inside[MESH_BVH_WIDTH];
  MESH_BVH_EACH(k) out[k] = inside[k] = FLT_MAX;
  for (int j = 0; j < 3; j++) {
    const float(*s)[MESH_BVH_WIDTH] = leaf->corner[j],
          (*e)[MESH_BVH_WIDTH] = leaf->corner[(j + 1) % 3];
    MESH_BVH_EACH(k) {
      float p[3] = {s[0][k], s[1][k], s[2][k]};
      float u[3] = {e[0][k] - p[0], e[1][k] - p[1], e[2][k] - p[2]};
      float n[3] = {leaf->normal[0][k], leaf->normal[1][k], leaf->normal[2][k]};
      float w0 = x[0] - p[0];
      float w1 = x[1] - p[1];
      float w2 = x[2] - p[2];
      float t = mesh_bvh_clamp01(mesh_bvh_dot(w0, w1, w2, u[0], u[1], u[2]) / mesh_bvh_dot3(u, u));
      float d0 = w0 - t * u[0];
      float d1 = w1 - t * u[1];
      float d2 = w2 - t * u[2];
      out[k] = mesh_bvh_min(out[k], mesh_bvh_dot(d0, d1, d2, d0, d1, d2));
      inside[k] = mesh_bvh_min(inside[k], mesh_bvh_side(x, p, u, n));
    }
  }
  const float(*s)[MESH_BVH_WIDTH] = leaf->corner[0], (*n)[MESH_BVH_WIDTH] = leaf->normal;
  MESH_BVH_EACH(k) {
    float h =
        mesh_bvh_dot(n[0][k], n[1][k], n[2][k], x[0] - s[0][k], x[1] - s[1][k], x[2] - s[2][k]);
    out[k] = mesh_bvh_min(out[k], inside[k] >= 0 ? h * h : FLT_MAX);
  }
}
// A triangle: one lane of a leaf.
typedef struct spheres_triangle {
  const mesh_bvh_leaf *leaf;
  size_t lane;
} spheres_triangle;

// Squared distance to the surface if below `limit`, else `limit`; the first one found to be at most
// `enough` will do. found: the nearest triangle, written only if below; or NULL.
static float spheres_nearest(const mesh_bvh *tree, const float *x, float limit, float enough,
                             spheres_triangle *found) {
  spheres_entry stack[MESH_BVH_STACK];
  size_t count = 1;
  float value[MESH_BVH_WIDTH];
  float best = limit;
  stack[0].at = mesh_bvh_root(tree);
  stack[0].distance = 0;
  while (count && best > enough) {
    spheres_entry top = stack[--count];
    if (top.distance >= best) continue;
    if (top.at & MESH_BVH_LEAF) {
      const mesh_bvh_leaf *leaf = &tree->leaves[top.at & ~MESH_BVH_LEAF];
      spheres_to_triangles(leaf, x, value);
      if (found) {
        MESH_BVH_EACH(k) if (value[k] < best) best = value[k], found->leaf = leaf, found->lane = k;
      } else {
        MESH_BVH_EACH(k) best = mesh_bvh_min(best, value[k]);
      }
      continue;
    }
    const mesh_bvh_node *node = &tree->nodes[top.at];
    spheres_to_boxes(node, x, value);
    unsigned mask = mesh_bvh_mask(value, best);
    size_t first = count;
    for (size_t k = 0; mask; k++, mask >>= 1) {  // the nearest on top
      spheres_entry next = {node->child[k], value[k]};
      if (!(mask & 1)) continue;
      stack[count] = next;
      if (count > first && next.distance > stack[count - 1].distance) {
        stack[count] = stack[count - 1];
        stack[count - 1] = next;
      }
      count++;
    }
  }
  return best;
}
// Is a triangle within `reach` > 0?
static int spheres_near(const mesh_bvh *tree, const float *x, float reach) {
  float r2 = reach * reach;
  return spheres_nearest(tree, x, r2, r2 * (1 - 1e-6f), NULL) < r2;
}
// Winding number of triangle k, seen along z, about the point: 1, -1, or 0 where it passes by. In
// double the products are exact, and an edge counts for the triangle on one side of it just as it
// does not for the other.
static int spheres_winding(const mesh_bvh_leaf *leaf, size_t k, const float *x) {
  int winding = 0;
  for (int j = 0; j < 3; j++) {
    int next = (j + 1) % 3;
    double u0 = (double)(leaf->corner[j][0][k] - x[0]);
    double v0 = (double)(leaf->corner[j][1][k] - x[1]);
    double u1 = (double)(leaf->corner[next][0][k] - x[0]);
    double v1 = (double)(leaf->corner[next][1][k] - x[1]);
    double turn = u0 * v1 - u1 * v0;
    if (v0 <= 0 && v1 > 0 && turn > 0) winding++;
    if (v1 <= 0 && v0 > 0 && turn < 0) winding--;
  }
  return winding;
}
// Adds up the surfaces that a ray along z, to the nearer side of the bounds, passes through.
static int spheres_inside(const mesh_bvh *tree, const float *x) {
  uint32_t stack[MESH_BVH_STACK];
  size_t count = 1;
  int sum = 0;
  float up = x[2] > tree->box.centre[2] ? 1.0f : -1.0f;
  float gap[MESH_BVH_WIDTH];
  stack[0] = mesh_bvh_root(tree);
  while (count) {
    uint32_t at = stack[--count];
    if (at & MESH_BVH_LEAF) {
      const mesh_bvh_leaf *leaf = &tree->leaves[at & ~MESH_BVH_LEAF];
      for (size_t k = 0; k < leaf->count; k++) {
        int winding = spheres_winding(leaf, k, x);
        float height = 0;
        for (int i = 0; i < 3; i++) height += leaf->normal[i][k] * (leaf->corner[0][i][k] - x[i]);
        if ((height > 0) == (up * (float)winding > 0)) sum += winding;
      }
      continue;
    }
    const mesh_bvh_node *node = &tree->nodes[at];
    MESH_BVH_EACH(k) {
      float a = fabsf(x[0] - node->centre[0][k]) - node->half[0][k];
      float b = fabsf(x[1] - node->centre[1][k]) - node->half[1][k];
      gap[k] =
          mesh_bvh_max(mesh_bvh_max(a, b), up * (x[2] - node->centre[2][k]) - node->half[2][k]);
    }
    unsigned mask = mesh_bvh_mask(gap, 0);
    for (size_t k = 0; mask; k++, mask >>= 1)
      if (mask & 1) stack[count++] = node->child[k];
  }
  return sum != 0;
}

// -------------------------------------------------------------------------------------------- grid

// The signed distance at the centre of the nearest cell, and how far away that is, rounding
// included.
static inline float spheres_look(const spheres_grid *g, const float *x, float *away) {
  size_t at[3];
  float sum = 0;
  for (int i = 0; i < 3; i++) {
    float f = (x[i] - g->low[i]) * g->inverse;
    f = mesh_bvh_min(mesh_bvh_max(f, 0), (float)(g->size[i] - 1));
    at[i] = (size_t)(int)f;
    float d = x[i] - g->low[i] - ((float)(int)f + 0.5f) * g->cell;
    sum += d * d;
  }
  *away = sqrtf(sum) + 1e-4f * g->cell;
  return g->distance[(at[2] * g->size[1] + at[1]) * g->size[0] + at[0]];
}
static int spheres_sign_at(const spheres_body *b, const float *x, float known, float away) {
  return fabsf(known) > away ? known < 0 : spheres_inside(b->tree, x);
}
// Every cell begins with what is known from the one before.
static int spheres_make_grid(spheres_body *b) {
  spheres_grid *g = &b->grid;
  const mesh_bvh_box *box = &b->tree->box;
  float extent = 0;
  float x[3];
  float last = 0;
  size_t total = 1;
  for (int i = 0; i < 3; i++) extent = mesh_bvh_max(extent, 2 * box->half[i]);
  g->cell = extent / SPHERES_CELLS;
  g->inverse = 1 / g->cell;
  for (int i = 0; i < 3; i++) {
    g->size[i] = (size_t)ceilf(2 * box->half[i] * g->inverse - 1e-3f);
    if (g->size[i] < 1) g->size[i] = 1;
    g->low[i] = box->centre[i] - 0.5f * (float)g->size[i] * g->cell;
    total *= g->size[i];
  }
  g->distance = (float *)malloc(total * sizeof(float));
  for (size_t i = 0; g->distance && i < total; i++) {
    size_t at[3] = {i % g->size[0], i / g->size[0] % g->size[1], i / (g->size[0] * g->size[1])};
    int follows = at[0] > 0;
    for (int k = 0; k < 3; k++) x[k] = g->low[k] + ((float)at[k] + 0.5f) * g->cell;
    float limit = follows ? 1.01f * (fabsf(last) + g->cell) : FLT_MAX;
    float d = sqrtf(spheres_nearest(b->tree, x, follows ? limit * limit : FLT_MAX, 0, NULL));
    int inside =
        follows ? spheres_sign_at(b, x, last, 1.001f * g->cell) : spheres_inside(b->tree, x);
    g->distance[i] = last = inside ? -d : d;
  }
  return g->distance != NULL;
}

// ----------------------------------------------------------------------------------------- spheres

static int spheres_add(spheres_body *b, const float *centre, float radius) {
  if (b->ball_count == b->ball_capacity) {
    size_t capacity = b->ball_capacity ? 2 * b->ball_capacity : 64;
    spheres_ball *larger = (spheres_ball *)realloc(b->balls, capacity * sizeof *larger);
    if (!larger) return 0;
    b->balls = larger;
    b->ball_capacity = capacity;
  }
  spheres_ball *ball = &b->balls[b->ball_count++];
  memcpy(ball->centre, centre, sizeof ball->centre);
  ball->radius = radius;
  return 1;
}
// One per voxel inside. Voxels are centred on the bounds; so many that they would fill the memory
// are made larger.
static int spheres_fill(spheres_body *b, float voxel) {
  const mesh_bvh_box *box = &b->tree->box;
  size_t size[3], total;
  do {
    total = 1;
    for (int i = 0; i < 3; i++) {
      size[i] = (size_t)fminf(fmaxf(ceilf(2 * box->half[i] / voxel - 1e-3f), 1), 65536);
      total *= size[i];
    }
    if (total > SPHERES_MOST_VOXELS) voxel *= 1.25f;
  } while (total > SPHERES_MOST_VOXELS);
  for (size_t i = 0; i < total; i++) {
    size_t at[3] = {i % size[0], i / size[0] % size[1], i / (size[0] * size[1])};
    float x[3], away;
    for (int k = 0; k < 3; k++)
      x[k] = box->centre[k] + ((float)at[k] - 0.5f * (float)(size[k] - 1)) * voxel;
    float known = spheres_look(&b->grid, x, &away);
    float most = 1.01f * (fabsf(known) + away);
    if (!spheres_sign_at(b, x, known, away)) continue;
    float clearance = sqrtf(spheres_nearest(b->tree, x, most * most, 0, NULL));
    if (clearance > 1e-3f * voxel && !spheres_add(b, x, clearance)) return 0;
  }
  return 1;
}
static int spheres_compare(const void *pa, const void *pb) {  // the largest first
  const spheres_ball *a = (const spheres_ball *)pa;
  const spheres_ball *b = (const spheres_ball *)pb;
  if (a->radius < b->radius || a->radius > b->radius) return a->radius > b->radius ? -1 : 1;
  for (int i = 0; i < 3; i++)
    if (a->centre[i] < b->centre[i] || a->centre[i] > b->centre[i])
      return a->centre[i] < b->centre[i] ? -1 : 1;
  return 0;
}
static void spheres_drop_contained(spheres_body *b, float slack) {
  size_t kept = 0;
  if (b->ball_count) qsort(b->balls, b->ball_count, sizeof *b->balls, spheres_compare);
  for (size_t i = 0; i < b->ball_count; i++) {
    const spheres_ball ball = b->balls[i];
    int contained = 0;
    for (size_t j = 0; j < kept && !contained; j++) {
      const spheres_ball *in = &b->balls[j];
      float d[3];
      float room = in->radius - ball.radius + slack;
      for (int k = 0; k < 3; k++) d[k] = ball.centre[k] - in->centre[k];
      contained = mesh_bvh_dot3(d, d) <= room * room;
    }
    if (!contained) b->balls[kept++] = ball;
  }
  b->ball_count = kept;
}
// The first corner of a triangle and the edges from it; returns twice its area.
static float spheres_edges(const nsvcd_mesh *mesh, size_t t, const float **corner, float *u,
                           float *v) {
  const float *p[3];
  float c[3];
  for (size_t k = 0; k < 3; k++) p[k] = mesh->positions + 3 * (size_t)mesh->indices[3 * t + k];
  for (int k = 0; k < 3; k++) {
    u[k] = p[1][k] - p[0][k];
    v[k] = p[2][k] - p[0][k];
  }
  mesh_bvh_cross(u, v, c);
  *corner = p[0];
  return sqrtf(mesh_bvh_dot3(c, c));
}
// Point i of n stands for the i-th part of the area, in the order of the triangles; within its
// triangle it falls by the two-dimensional golden ratio (Roberts 2018). Deterministic, and more
// even than random points.
static int spheres_sample(spheres_body *b, const nsvcd_mesh *mesh, size_t n) {
  double total = 0;
  double passed = 0;
  for (int pass = 0; pass < 2; pass++) {
    size_t made = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
      const float *corner;
      float u[3], v[3];
      *(pass ? &passed : &total) += (double)spheres_edges(mesh, t, &corner, u, v);
      for (; pass && made < n && ((double)made + 0.5) / (double)n * total <= passed; made++) {
        double f = fmod(0.5 + 0.7548776662466927 * (double)made, 1);
        double g = fmod(0.5 + 0.5698402909980532 * (double)made, 1);
        float a = (float)(f + g > 1 ? 1 - f : f);
        float e = (float)(f + g > 1 ? 1 - g : g);
        float x[3];
        for (int k = 0; k < 3; k++) x[k] = corner[k] + a * u[k] + e * v[k];
        if (!spheres_add(b, x, SPHERES_SURFACE_RADIUS)) return 0;
      }
    }
  }
  return 1;
}
static void spheres_bound(const spheres_ball *balls, size_t count, spheres_ball *out) {
  float low[3], high[3];
  mesh_bvh_empty(low, high);
  for (size_t i = 0; i < count; i++)
    for (int k = 0; k < 3; k++) {
      low[k] = mesh_bvh_min(low[k], balls[i].centre[k] - balls[i].radius);
      high[k] = mesh_bvh_max(high[k], balls[i].centre[k] + balls[i].radius);
    }
  for (int k = 0; k < 3; k++) out->centre[k] = (low[k] + high[k]) / 2;
  out->radius = 0;
  for (size_t i = 0; i < count; i++) {
    float d[3];
    for (int k = 0; k < 3; k++) d[k] = balls[i].centre[k] - out->centre[k];
    out->radius =
        mesh_bvh_max(out->radius, 1.000001f * (sqrtf(mesh_bvh_dot3(d, d)) + balls[i].radius));
  }
}
// Sorts along the axis on which the centres are spread most. keys, scratch: (count).
static void spheres_sort(spheres_ball *balls, size_t count, mesh_bvh_key *keys,
                         spheres_ball *scratch) {
  float low[3], high[3];
  int axis = 0;
  mesh_bvh_empty(low, high);
  for (size_t i = 0; i < count; i++) {
    for (int k = 0; k < 3; k++) {
      low[k] = mesh_bvh_min(low[k], balls[i].centre[k]);
      high[k] = mesh_bvh_max(high[k], balls[i].centre[k]);
    }
  }
  for (int k = 1; k < 3; k++)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  for (size_t i = 0; i < count; i++) {
    keys[i].value = balls[i].centre[axis];
    keys[i].triangle = (uint32_t)i;
  }
  qsort(keys, count, sizeof *keys, mesh_bvh_compare);
  memcpy(scratch, balls, count * sizeof *balls);
  for (size_t i = 0; i < count; i++) balls[i] = scratch[keys[i].triangle];
}
// Halves along the widest axis. Nodes: at most 2 ball_count - 1.
static void spheres_build(spheres_body *b, mesh_bvh_key *keys, spheres_ball *scratch, size_t first,
                          size_t count) {
  spheres_node *node = &b->nodes[b->node_count++];
  spheres_ball *balls = b->balls + first;
  spheres_bound(balls, count, &node->ball);
  node->first = (uint32_t)first;
  node->count = count <= SPHERES_GROUP ? (uint32_t)count : 0;
  if (!node->count) {
    spheres_sort(balls, count, keys, scratch);
    spheres_build(b, keys, scratch, first, count / 2);
    spheres_build(b, keys, scratch, first + count / 2, count - count / 2);
  }
  node->next = (uint32_t)b->node_count;
}
static int spheres_make_tree(spheres_body *b) {
  size_t n = b->ball_count;
  mesh_bvh_key *keys = (mesh_bvh_key *)malloc(n * sizeof *keys);
  spheres_ball *scratch = (spheres_ball *)malloc(n * sizeof *scratch);
  b->nodes = (spheres_node *)malloc(2 * n * sizeof *b->nodes);
  int ok = keys && scratch && b->nodes;
  if (ok) spheres_build(b, keys, scratch, 0, n);
  free(keys);
  free(scratch);
  return ok;
}
static void spheres_release(void *body) {
  spheres_body *b = (spheres_body *)body;
  if (!b) return;
  mesh_bvh_release(b->tree);
  free(b->grid.distance);
  free(b->balls);
  free(b->nodes);
  free(b);
}
static size_t spheres_bytes(const void *body) {
  const spheres_body *b = (const spheres_body *)body;
  size_t cells = b->grid.size[0] * b->grid.size[1] * b->grid.size[2];
  return sizeof *b + mesh_bvh_bytes(b->tree) + cells * sizeof(float) +
         b->ball_count * sizeof *b->balls + b->node_count * sizeof *b->nodes;
}
static void *spheres_prepare(const nsvcd_mesh *mesh, const preparation *how) {
  spheres_body *b = (spheres_body *)calloc(1, sizeof *b);
  if (!b) return NULL;
  b->tree = (mesh_bvh *)mesh_bvh_prepare(mesh, NULL);
  int ok = b->tree && spheres_make_grid(b) && (!(how->detail > 0) || spheres_fill(b, how->detail));
  if (ok) spheres_drop_contained(b, 0.1f * how->detail);
  ok = ok && spheres_sample(b, mesh, how->points || b->ball_count ? how->points : SPHERES_FALLBACK);
  if (ok && b->ball_count && spheres_make_tree(b)) return b;
  spheres_release(b);
  return NULL;
}

// ----------------------------------------------------------------------------------------- queries

// Does a sphere, with the activation in its radius, hit the mesh? `known` and `away` are what the
// grid says.
static int spheres_hit(const spheres_body *fixed, const float *x, float radius, float known,
                       float away) {
  if (known + away < radius) return 1;
  if (radius > 0 && spheres_near(fixed->tree, x, radius)) return 1;
  if (!spheres_sign_at(fixed, x, known, away)) return 0;
  return radius >= 0 || !spheres_near(fixed->tree, x, -radius);
}
// Places a sphere's centre. 1 if it is certainly farther from the mesh than `radius`.
static inline int spheres_place(const spheres_body *fixed, const transform *at,
                                const spheres_ball *ball, float radius, float *x, float *known,
                                float *away) {
  const mesh_bvh_box *box = &fixed->tree->box;
  float outside = 0;
  for (int i = 0; i < 3; i++) {
    x[i] = mesh_bvh_dot3(at->rotation + 3 * i, ball->centre) + at->position[i];
    float d = mesh_bvh_max(fabsf(x[i] - box->centre[i]) - box->half[i], 0);
    outside += d * d;
  }
  if (outside > 0 && (radius < 0 || outside > radius * radius)) return 1;
  *known = spheres_look(&fixed->grid, x, away);
  return *known - *away > radius;
}
static int spheres_collide(const spheres_body *moving, const spheres_body *fixed,
                           const transform *at, float activation) {
  float x[3], known, away;
  for (size_t i = 0; i < moving->node_count;) {
    const spheres_node *node = &moving->nodes[i];
    if (spheres_place(fixed, at, &node->ball, node->ball.radius + activation, x, &known, &away)) {
      i = node->next;
      continue;
    }
    for (size_t j = node->first; j < node->first + node->count; j++) {
      const spheres_ball *ball = &moving->balls[j];
      float radius = ball->radius + activation;
      if (spheres_place(fixed, at, ball, radius, x, &known, &away)) continue;
      if (spheres_hit(fixed, x, radius, known, away)) return 1;
    }
    i++;
  }
  return 0;
}
static int spheres_hits(const void *moving, const void *fixed, const transform *at, size_t count,
                        float activation) {
  for (size_t i = 0; i < count; i++)
    if (spheres_collide((const spheres_body *)moving, (const spheres_body *)fixed, &at[i],
                        activation))
      return 1;
  return 0;
}

static const method spheres_method = {"spheres, sphere-mesh distance",
                                      spheres_prepare,
                                      NULL,
                                      spheres_release,
                                      spheres_bytes,
                                      spheres_hits};

#endif  // NSVCD_BENCH_SPHERES_H
