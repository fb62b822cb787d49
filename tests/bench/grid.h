// grid.h - a method of the benchmark: points on the moving body, looked up in a distance grid
// of the fixed one.
//
// In:  a mesh in metres. Out: grid_method (method.h). Reads preparation.points: points on the
//      surface (0: 1000), and preparation.detail: cells along the longest extent (0: 64). Sources:
//      the point shell of McNeely et al. 1999 ("Six degree-of-freedom haptic rendering using voxel
//      sampling"), with signed distances in place of voxels.
//
// Points. Spread evenly over the area (spheres.h), then grouped by eights, and these by
// eights again: a node keeps the bounding spheres of its children side by side, and a test is one
// loop over eight lanes, as in mesh.h.
//
// Grid. Signed distances at the nodes of a regular grid, in cells. Those near the surface are
// exact; those far away are bounds from a coarser grid: if s is the distance at the middle of some
// nodes, and r^2 their mean squared distance from there, then the mean of their own squared
// distances is at most s^2 + r^2, since for each the middle's nearest point is one to choose from
// (the mean of its directions cancels). The sign is that of the winding number, summed up column by
// column: bodies may be unions of overlapping closed parts. An open mesh gets an arbitrary inside.
//
// Query. Distance changes by at most the way gone, so the nearest node bounds it: whoever is
// farther than its sphere's radius + activation is skipped, a group of points and a point alike.
// What is left is interpolated, and is a hit if below `activation`. Beyond the grid the bound is
// that of the nearest place within, at a right angle to the way there.
//
// What it cannot see: an edge of the fixed body between two points, and a wall thinner than a cell,
// whose inside falls between the nodes. Both roles are prepared at once; `bytes` counts both.
#ifndef NSVCD_BENCH_GRID_H
#define NSVCD_BENCH_GRID_H

#include "spheres.h"  // spheres_nearest, spheres_sample, spheres_bound

// Distances are stored in 256ths of a cell: fine enough for any use, and up to 128 cells fit 16
// bits.
enum {
  GRID_CELLS = 64,
  GRID_MOST_CELLS = 256,
  GRID_POINTS = 1000,
  GRID_PAD = 2,
  GRID_STEP = 4,
  GRID_UNIT = 256
};
enum { GRID_WIDTH = 8, GRID_STACK = 128 };  // 11 levels leave 7 behind each: 2^32 points fit
#define GRID_EACH(k) for (size_t k = 0; k < GRID_WIDTH; k++)

typedef struct grid_node {
  // metres; an unused lane's radius is so negative that it is skipped
  float centre[3][GRID_WIDTH], radius[GRID_WIDTH];
  uint32_t first;  // of the children, which lie in a row
  uint32_t leaf;   // the spheres are points
} grid_node;

typedef struct grid_body {
  float low[3], cell;  // metres
  int size[3];         // nodes of the grid, a multiple of GRID_STEP and one
  grid_node *nodes;    // the root first
  int16_t *distance;   // (size[2], size[1], size[0]) negative inside
  size_t node_count, bytes;
} grid_body;

typedef struct grid_builder {
  const nsvcd_mesh *mesh;
  mesh_bvh *tree;
  spheres_body shell;     // its balls are the points
  spheres_ball *scratch;  // (points)
  mesh_bvh_key *keys;     // (points)
  float *distance;        // as in the body, in cells, unsigned
  int16_t *winding;       // as in the body: what changes between a node and the one below it
  grid_body body;
} grid_builder;

// ------------------------------------------------------------------------------------------ points

// Halves the points until they come in units. Cut at whole units, so that all groups but the last
// are full.
static void grid_cut(grid_builder *b, size_t first, size_t count, size_t unit) {
  if (count <= unit) return;
  size_t left = ((count + unit - 1) / unit + 1) / 2 * unit;
  spheres_sort(b->shell.balls + first, count, b->keys, b->scratch);
  grid_cut(b, first, left, unit);
  grid_cut(b, first + left, count - left, unit);
}
static void grid_group(grid_builder *b, size_t index, size_t first, size_t count) {
  grid_node *node = &b->body.nodes[index];
  size_t unit = 1;
  size_t below = b->body.node_count;
  while (GRID_WIDTH * unit < count) unit *= GRID_WIDTH;
  size_t children = (count + unit - 1) / unit;
  memset(node, 0, sizeof *node);
  node->first = (uint32_t)below;
  node->leaf = unit == 1;
  if (!node->leaf) {
    grid_cut(b, first, count, unit);
    b->body.node_count += children;
  }
  GRID_EACH(k) {
    spheres_ball ball = {{0, 0, 0}, -1e30f};
    size_t at = k * unit;
    size_t n = k + 1 < children ? unit : count - at;
    if (k < children) spheres_bound(b->shell.balls + first + at, n, &ball);
    for (int i = 0; i < 3; i++) node->centre[i][k] = ball.centre[i];
    node->radius[k] = ball.radius;
    if (k < children && !node->leaf) grid_group(b, below + k, first + at, n);
  }
}
static int grid_make_shell(grid_builder *b, size_t points) {
  for (size_t i = 0; i < b->mesh->vertex_count && i < points; i++)
    if (!spheres_add(&b->shell, b->mesh->positions + 3 * i, 0)) return 0;
  if (!spheres_sample(&b->shell, b->mesh, points) || !b->shell.ball_count) return 0;
  size_t n = b->shell.ball_count;
  for (size_t i = 0; i < n; i++) b->shell.balls[i].radius = 0;
  b->scratch = (spheres_ball *)malloc(n * sizeof *b->scratch);
  b->keys = (mesh_bvh_key *)malloc(n * sizeof *b->keys);
  // all but one per level are full
  b->body.nodes = (grid_node *)malloc((n / 4 + 16) * sizeof *b->body.nodes);
  if (!b->scratch || !b->keys || !b->body.nodes) return 0;
  b->body.node_count = 1;
  grid_group(b, 0, 0, n);
  return 1;
}

// -------------------------------------------------------------------------------------------- grid

static inline size_t grid_index(const grid_body *g, int x, int y, int z) {
  return ((size_t)z * (size_t)g->size[1] + (size_t)y) * (size_t)g->size[0] + (size_t)x;
}
static int grid_clamp(float x, int most) {
  return (int)mesh_bvh_min(mesh_bvh_max(x, 0), (float)most);
}
static size_t grid_total(const grid_body *g) {
  return (size_t)g->size[0] * (size_t)g->size[1] * (size_t)g->size[2];
}
static void grid_set_size(grid_body *g, const mesh_bvh_box *box, float cells) {
  float extent = 0;
  for (int i = 0; i < 3; i++) extent = mesh_bvh_max(extent, 2 * box->half[i]);
  g->cell = extent / cells;
  for (int i = 0; i < 3; i++) {
    int wanted = (int)ceilf(2 * box->half[i] / g->cell - 1e-3f) + 2 * GRID_PAD;
    g->size[i] = (wanted + GRID_STEP - 1) / GRID_STEP * GRID_STEP + 1;
    g->low[i] = box->centre[i] - 0.5f * (float)(g->size[i] - 1) * g->cell;
  }
}
// Squared distance, in cells, of a node at the middle of nodes `step` away along its odd axes: at
// least this.
static float grid_bound(const grid_builder *b, const int *at, int step) {
  const grid_body *g = &b->body;
  int way[3];
  int odd = 0;
  float sum = 0;
  for (int i = 0; i < 3; i++) {
    way[i] = at[i] & step;
    odd += way[i] != 0;
  }
  for (int c = 0; c < 8; c++) {
    int x = at[0] + (c & 1 ? way[0] : -way[0]);
    int y = at[1] + (c & 2 ? way[1] : -way[1]);
    float d = b->distance[grid_index(g, x, y, at[2] + (c & 4 ? way[2] : -way[2]))];
    sum += d * d;
  }
  return odd ? sum / 8 - (float)(odd * step * step) : 0;
}
// Fills the nodes at multiples of `step` that those at multiples of 2 * step leave open, a row
// along x. The last exact distance limits the search for the next one.
static void grid_fill_row(grid_builder *b, int y, int z, int step) {
  const grid_body *g = &b->body;
  int done = step < GRID_STEP;
  int whole = done && !(y & step) && !(z & step);
  int last = -1;
  float far = 5.0f * (float)(step * step);
  float d = 0;
  for (int x = whole ? step : 0; x < g->size[0]; x += whole ? 2 * step : step) {
    int at[3] = {x, y, z};
    float *out = &b->distance[grid_index(g, x, y, z)];
    float bound = done ? grid_bound(b, at, step) : 0;
    float p[3];
    if (bound > far) {
      *out = sqrtf(bound);
      continue;
    }
    for (int i = 0; i < 3; i++) p[i] = g->low[i] + (float)at[i] * g->cell;
    float limit = last < 0 ? FLT_MAX : 1.001f * (d + (float)(x - last) + 0.01f) * g->cell;
    d = sqrtf(spheres_nearest(b->tree, p, last < 0 ? FLT_MAX : limit * limit, 0, NULL)) / g->cell;
    *out = d, last = x;
  }
}
// Winding number of a triangle, seen along z, about a column: 1, -1, or 0 where it passes by. In
// double the products are exact, and an edge counts for the triangle on one side of it just as it
// does not for the other.
static int grid_column(const float *const *corner, float x, float y) {
  int winding = 0;
  for (int j = 0; j < 3; j++) {
    const float *p = corner[j];
    const float *q = corner[(j + 1) % 3];
    double u0 = (double)(p[0] - x);
    double v0 = (double)(p[1] - y);
    double u1 = (double)(q[0] - x);
    double v1 = (double)(q[1] - y);
    double turn = u0 * v1 - u1 * v0;
    if (v0 <= 0 && v1 > 0 && turn > 0) winding++;
    if (v1 <= 0 && v0 > 0 && turn < 0) winding--;
  }
  return winding;
}
// Notes at the first node above the triangle, in every column through it, that the winding number
// changes there.
static void grid_wind(grid_builder *b, size_t triangle) {
  const grid_body *g = &b->body;
  const float *p[3];
  float u[3], v[3], n[3], low[3], high[3];
  int begin[3], end[3];
  for (size_t k = 0; k < 3; k++)
    p[k] = b->mesh->positions + 3 * (size_t)b->mesh->indices[3 * triangle + k];
  for (int k = 0; k < 3; k++) {
    u[k] = p[1][k] - p[0][k];
    v[k] = p[2][k] - p[0][k];
  }
  mesh_bvh_cross(u, v, n);
  for (int k = 0; k < 3;
       // clamped: a triangle without an area may leave the bounds, which count only the others
       k++) {
    low[k] = mesh_bvh_min(mesh_bvh_min(p[0][k], p[1][k]), p[2][k]);
    high[k] = mesh_bvh_max(mesh_bvh_max(p[0][k], p[1][k]), p[2][k]);
    begin[k] = grid_clamp((low[k] - g->low[k]) / g->cell, g->size[k] - 1);
    end[k] = grid_clamp((high[k] - g->low[k]) / g->cell + 1, g->size[k] - 1);
  }
  for (int j = begin[1]; j <= end[1]; j++)
    for (int i = begin[0]; i <= end[0]; i++) {
      float x = g->low[0] + (float)i * g->cell;
      float y = g->low[1] + (float)j * g->cell;
      float z = low[2];
      int winding = grid_column(p, x, y);
      if (!winding) continue;
      if (n[2] < 0 || n[2] > 0) z = p[0][2] - (n[0] * (x - p[0][0]) + n[1] * (y - p[0][1])) / n[2];
      z = mesh_bvh_min(mesh_bvh_max(z, low[2]), high[2]);  // steep ones round badly
      int k = grid_clamp(ceilf((z - g->low[2]) / g->cell), g->size[2] - 1);
      b->winding[grid_index(g, i, j, k)] = (int16_t)(b->winding[grid_index(g, i, j, k)] + winding);
    }
}
static int grid_make_grid(grid_builder *b, float cells) {
  grid_body *g = &b->body;
  grid_set_size(g, &b->tree->box, cells);
  size_t total = grid_total(g);
  size_t layer = (size_t)g->size[0] * (size_t)g->size[1];
  b->distance = (float *)malloc(total * sizeof *b->distance);
  b->winding = (int16_t *)calloc(total, sizeof *b->winding);
  if (!b->distance || !b->winding) return 0;
  for (int step = GRID_STEP; step; step /= 2)
    for (int z = 0; z < g->size[2]; z += step)
      for (int y = 0; y < g->size[1]; y += step) grid_fill_row(b, y, z, step);
  for (size_t i = 0; i < b->mesh->triangle_count; i++) grid_wind(b, i);
  for (size_t i = layer; i < total; i++)
    b->winding[i] = (int16_t)(b->winding[i] + b->winding[i - layer]);
  return 1;
}

// -------------------------------------------------------------------------------------------- body

static void grid_point(grid_body *body) {
  body->nodes = (grid_node *)(void *)(body + 1);
  body->distance = (int16_t *)(void *)(body->nodes + body->node_count);
}
// One block: the struct, the nodes, the distances.
static grid_body *grid_pack(const grid_builder *b) {
  size_t total = grid_total(&b->body);
  size_t nodes = b->body.node_count * sizeof(grid_node);
  size_t bytes = sizeof(grid_body) + nodes + total * sizeof(int16_t);
  grid_body *to = (grid_body *)malloc(bytes);
  if (!to) return NULL;
  *to = b->body, to->bytes = bytes;
  grid_point(to);
  memcpy(to->nodes, b->body.nodes, nodes);
  for (size_t i = 0; i < total; i++) {
    int d = (int)(mesh_bvh_min(GRID_UNIT * b->distance[i], 32767.0f) + 0.5f);
    to->distance[i] = (int16_t)(b->winding[i] ? -d : d);
  }
  return to;
}
static void *grid_prepare(const nsvcd_mesh *mesh, const preparation *how) {
  grid_builder b;
  grid_body *out = NULL;
  float cells =
      how->detail > 0 ? mesh_bvh_min(mesh_bvh_max(how->detail, 2), GRID_MOST_CELLS) : GRID_CELLS;
  memset(&b, 0, sizeof b);
  b.mesh = mesh;
  b.tree = (mesh_bvh *)mesh_bvh_prepare(mesh, NULL);
  if (b.tree && grid_make_shell(&b, how->points ? how->points : GRID_POINTS) &&
      grid_make_grid(&b, cells))
    out = grid_pack(&b);
  mesh_bvh_release(b.tree);
  free(b.shell.balls);
  free(b.scratch);
  free(b.keys);
  free(b.body.nodes);
  free(b.distance);
  free(b.winding);
  return out;
}
static void grid_release(void *body) {
  free(body);
}
static size_t grid_bytes(const void *body) {
  return ((const grid_body *)body)->bytes;
}
static void *grid_scaled(const void *body, float scale) {
  const grid_body *from = (const grid_body *)body;
  grid_body *to = (grid_body *)malloc(from->bytes);
  if (!to) return NULL;
  memcpy(to, from, from->bytes);
  grid_point(to);
  mesh_bvh_scale_floats(to->low, 3, scale);
  to->cell *= scale;
  for (size_t i = 0; i < to->node_count; i++) {
    mesh_bvh_scale_floats(to->nodes[i].centre[0], 3 * GRID_WIDTH, scale);
    mesh_bvh_scale_floats(to->nodes[i].radius, GRID_WIDTH, scale);
  }
  return to;
}

// ----------------------------------------------------------------------------------------- queries

typedef struct grid_query {
  const grid_body *moving, *fixed;
  float r[9], p[3];  // from the moving body's metres to the fixed one's cells
  float inverse;     // cells per metre
  float activation;  // cells
} grid_query;

// Eight places in the grid, in cells, moved onto it if beyond, and how far squared.
typedef struct grid_lanes {
  float x[3][GRID_WIDTH], beyond[GRID_WIDTH];
} grid_lanes;

static void grid_place(grid_query *q, const transform *at) {
  for (int i = 0; i < 9; i++) q->r[i] = at->rotation[i] * q->inverse;
  for (int i = 0; i < 3; i++) q->p[i] = (at->position[i] - q->fixed->low[i]) * q->inverse;
}
static inline float grid_beyond(float d, float beyond) {
  return d > 0 ? sqrtf(d * d + beyond) : d;
}
// The children that may be within reach, and by how much.
static inline unsigned grid_reach(const grid_query *q, const grid_node *node, grid_lanes *out,
                                  float *gap) {
  const grid_body *g = q->fixed;
  int index[GRID_WIDTH];
  int stride = 1;
  float away[GRID_WIDTH];
  GRID_EACH(k) index[k] = 0, away[k] = out->beyond[k] = 0;
  for (int i = 0; i < 3; i++) {
    float rx = q->r[3 * i];
    float ry = q->r[3 * i + 1];
    float rz = q->r[3 * i + 2];
    float p = q->p[i];
    float most = (float)(g->size[i] - 1);
    GRID_EACH(k) {
      float at =
          p + mesh_bvh_dot(rx, ry, rz, node->centre[0][k], node->centre[1][k], node->centre[2][k]);
      float x = mesh_bvh_min(mesh_bvh_max(at, 0), most);
      int nearest = (int)(x + 0.5f);
      float d = x - (float)nearest;
      float e = at - x;
      out->x[i][k] = x;
      index[k] += stride * nearest;
      away[k] = MESH_BVH_FMA(d, d, away[k]);
      out->beyond[k] = MESH_BVH_FMA(e, e, out->beyond[k]);
    }
    stride *= g->size[i];
  }
  GRID_EACH(k) gap[k] = g->distance[index[k]];
  GRID_EACH(k) {
    float d = gap[k] * (1.0f / GRID_UNIT) - sqrtf(away[k]) - 2.0f / GRID_UNIT;  // rounding included
    gap[k] = grid_beyond(d, out->beyond[k]) - node->radius[k] * q->inverse;
  }
  return mesh_bvh_mask(gap, q->activation);
}
static float grid_interpolate(const grid_body *g, const grid_lanes *at, size_t k) {
  size_t index = 0;
  size_t stride[3] = {1, (size_t)g->size[0], (size_t)g->size[0] * (size_t)g->size[1]};
  float f[3], rows[4];
  for (int i = 0; i < 3; i++) {
    int low = (int)mesh_bvh_min(at->x[i][k], (float)(g->size[i] - 2));
    f[i] = at->x[i][k] - (float)low;
    index += (size_t)low * stride[i];
  }
  for (size_t c = 0; c < 4; c++) {
    const int16_t *d = g->distance + index + (c & 1) * stride[1] + (c >> 1) * stride[2];
    rows[c] = (float)d[0] + f[0] * (float)(d[1] - d[0]);
  }
  float front = rows[0] + f[1] * (rows[1] - rows[0]);
  float back = rows[2] + f[1] * (rows[3] - rows[2]);
  return grid_beyond((front + f[2] * (back - front)) * (1.0f / GRID_UNIT), at->beyond[k]);
}
// Is a point below the activation? Depth first, the deepest child on top. With `nearest` it goes on:
// q->activation becomes the least distance, in cells, and nearest where that is.
static int grid_search(grid_query *q, float *nearest) {
  uint32_t stack[GRID_STACK];
  size_t count = 1;
  int found = 0;
  stack[0] = 0;
  while (count) {
    const grid_node *node = &q->moving->nodes[stack[--count]];
    grid_lanes at;
    float gap[GRID_WIDTH];
    float deepest = FLT_MAX;
    unsigned mask = grid_reach(q, node, &at, gap);
    for (uint32_t k = 0; mask; k++, mask >>= 1) {
      if (!(mask & 1)) continue;
      if (node->leaf) {
        const float distance = grid_interpolate(q->fixed, &at, k);
        if (!(distance < q->activation)) continue;
        if (!nearest) return 1;
        found = 1;
        q->activation = distance;
        for (int i = 0; i < 3; i++) {
          const float *r = q->r + 3 * i;
          nearest[i] = q->p[i] + mesh_bvh_dot(r[0], r[1], r[2], node->centre[0][k],
                                              node->centre[1][k], node->centre[2][k]);
        }
        continue;
      }
      stack[count] = node->first + k;
      if (gap[k] < deepest) {
        deepest = gap[k];
      } else {
        stack[count] = stack[count - 1];
        stack[count - 1] = node->first + k;
      }
      count++;
    }
  }
  return found;
}
static int grid_hits(const void *moving, const void *fixed, const transform *at, size_t count,
                     float activation) {
  grid_query q;
  q.moving = (const grid_body *)moving;
  q.fixed = (const grid_body *)fixed;
  q.inverse = 1 / q.fixed->cell;
  q.activation = activation * q.inverse;
  for (size_t i = 0; i < count; i++) {
    grid_place(&q, &at[i]);
    if (grid_search(&q, NULL)) return 1;
  }
  return 0;
}

static const method grid_method = {"point shell in a distance grid",
                                   grid_prepare,
                                   grid_scaled,
                                   grid_release,
                                   grid_bytes,
                                   grid_hits};

#endif  // NSVCD_BENCH_GRID_H
