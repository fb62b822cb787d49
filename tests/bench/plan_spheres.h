// plan_spheres.h - the collision cost of a sphere planner (as cuRobo's) for nsvcd_plan: the peer of
// the benchmark.
//
// In:  a scene of scenery/tasks.h, numbers of spheres, the activation distance.
// Out: plan_spheres_cost, to be called from nsvcd_plan_problem.collision: the cost of poses
//      (samples, bodies), the verdict, the derivative.
// Sources: cuRobo (Sundaralingam et al. 2023) and appendices B and D of the NeuralSVCD paper.
//
//   plan_spheres s;
//   if (!plan_spheres_init(&s, &scene, 397, 400, 0.04f, 1, 0)) ...     // once per scene
//   if (!plan_spheres_select(&s, &scene)) ...                         // after each task_select
//   // allocates nothing; one thread per struct
//   cost = plan_spheres_cost(&s, poses, samples, limit, &collides, gradient);
//   plan_spheres_free(&s);
//
// Cost. Per pair, sample and sphere, with d = the signed distance of its centre from the other
// body's mesh, less its radius: 0 from the activation distance e on, (e - d)^2 / 2e nearer than
// that, e/2 - d in contact: cuRobo's. The verdict is d < 0 anywhere. Of two moving bodies the one
// with more spheres per area is the one made of spheres.
//
// Spheres. A robot's are shared out by area over those of its bodies that a pair measures with
// spheres. Interior ones by voxels (spheres.h: all of such a sphere is inside, and those that
// others contain are dropped); the rest, at least a quarter, as cuRobo's default, are points of 2
// mm radius on the surface, each put where the surface is farthest from all spheres so far. Of all
// voxel edges the one whose spheres leave the least of such a distance is taken.
//
// Distance. A grid of signed distances, interpolated trilinearly, as far out as it matters. Where a
// cell's centre says that interpolation is off by more than PLAN_SPHERES_ERROR (edges, thin walls)
// the mesh's tree is asked: exact, 0.3 us. With `exact` it always is, and the grid only tells what
// is too far away to matter. The sign is the winding number's.
//
// Culling. The box of a body's whole way against the other's, if that stands still; then per sample
// the body's sphere against the other's box; then eight spheres of eight spheres each at a time
// against the grid; then eight spheres.
#ifndef NSVCD_BENCH_PLAN_SPHERES_H
#define NSVCD_BENCH_PLAN_SPHERES_H

#include "../../examples/scenery/clock.h"
#include "../../examples/scenery/tasks.h"
#include "spheres.h"

#define PLAN_SPHERES_DEF static __attribute__((unused))
// metres: a cell is interpolated in if its centre is this near the truth
#define PLAN_SPHERES_ERROR 2.5e-4f
// gcc unrolls such short loops before it makes vectors of them, and then finds fewer.
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 8
#define PLAN_SPHERES_EACH(k) _Pragma("GCC unroll 1") for (int k = 0; k < 8; k++)
#else
#define PLAN_SPHERES_EACH(k) for (int k = 0; k < 8; k++)
#endif
enum { PLAN_SPHERES_CHUNK = 64, PLAN_SPHERES_NODES = 600000 };

typedef struct plan_spheres_eight {
  float centre[3][8], radius[8];  // an unused lane has a radius that reaches nothing
} plan_spheres_eight;

typedef struct plan_spheres_grid {
  // last: the greatest coordinate in cells, just within the last one
  float low[3], cell[3], inverse[3], last[3];
  int size[3];  // nodes
  float bound;  // interpolation is never off by more
  // (size[2], size[1], size[0]); farther than what matters: a lower bound
  float *value;
  // a bit per node: interpolation is not good enough in the cell above it
  unsigned char *rough;
} plan_spheres_grid;

typedef struct plan_spheres_body {
  spheres_body *fit;           // mesh tree and spheres
  plan_spheres_eight *eights;  // the spheres, (eight_count)
  plan_spheres_eight *bounds;  // of eights, (eight_count / 8, rounded up)
  size_t eight_count;
  float centre[3], radius;  // around all spheres
  float area;
  int moves;
  plan_spheres_grid grid;  // once a pair needs it
} plan_spheres_body;

typedef struct plan_spheres {
  float activation, weight;
  int exact;
  plan_spheres_body bodies[TASK_MAX_BODIES];
  int body_count;
  int pairs[TASK_MAX_PAIRS][2];  // whose spheres, whose mesh
  int pair_count;
  float most_radius;    // of any sphere
  float *placed;        // (bodies, CHUNK, 15): rotation, position, the centre of all spheres
  double seconds;       // spent in plan_spheres_cost
  size_t calls, tests;  // spheres looked up, eights in one go counting eight
  size_t asked;         // of these, distances measured by the mesh's tree
} plan_spheres;

// ---------------------------------------------------------------------------------------- distance

static float plan_spheres_dot(const float *a, const float *b) {
  return mesh_bvh_dot3(a, b);
}

// The point of triangle k of the leaf that is nearest to x.
static void plan_spheres_on_triangle(const mesh_bvh_leaf *leaf, size_t k, const float *x,
                                     float *out) {
  float p[3][3];
  float n[3];
  float best = FLT_MAX;
  float height = 0;
  int over = 1;
  for (int i = 0; i < 3; i++) {
    n[i] = leaf->normal[i][k];
    for (int c = 0; c < 3; c++) p[c][i] = leaf->corner[c][i][k];
    height += n[i] * (x[i] - p[0][i]);
  }
  for (int c = 0; c < 3; c++) {
    float u[3];
    float w[3];
    float at[3];
    float square = 0;
    for (int i = 0; i < 3; i++) {
      u[i] = p[(c + 1) % 3][i] - p[c][i];
      w[i] = x[i] - p[c][i];
    }
    float t = mesh_bvh_clamp01(plan_spheres_dot(w, u) / plan_spheres_dot(u, u));
    for (int i = 0; i < 3; i++) {
      at[i] = p[c][i] + t * u[i];
      square += (x[i] - at[i]) * (x[i] - at[i]);
    }
    if (mesh_bvh_side(x, p[c], u, n) < 0) over = 0;
    if (square < best) {
      best = square;
      memcpy(out, at, sizeof at);
    }
  }
  for (int i = 0; over && i < 3; i++) out[i] = x[i] - height * n[i];
}
// As spheres_nearest, and where that is: the squared distance if below `limit`, else `limit`;
// `point` and `normal` of the nearest triangle are written only if below.
static float plan_spheres_nearest(const mesh_bvh *tree, const float *x, float limit, float *point,
                                  float *normal) {
  spheres_triangle found;
  const float best = spheres_nearest(tree, x, limit, 0, &found);
  if (!(best < limit)) return limit;
  plan_spheres_on_triangle(found.leaf, found.lane, x, point);
  for (int i = 0; i < 3; i++) normal[i] = found.leaf->normal[i][found.lane];
  return best;
}
// The exact signed distance if below `reach`, else `reach`, and its gradient. `sign`: 1, -1, or 0:
// not known.
static float plan_spheres_measure(const plan_spheres_body *b, const float *x, float reach,
                                  float sign, float *gradient) {
  float point[3];
  float normal[3] = {0, 0, 1};
  float limit = reach > 0 && sign > 0 ? reach * reach : FLT_MAX;
  float square = plan_spheres_nearest(b->fit->tree, x, limit, point, normal);
  if (!(square < limit)) return reach;
  if (sign >= 0 && sign <= 0) sign = spheres_inside(b->fit->tree, x) ? -1.0f : 1.0f;
  float distance = sqrtf(square);
  if (sign > 0 && distance >= reach) return reach;
  // At the surface the direction would be rounding: the normal is right unless the body is open.
  for (int i = 0; i < 3; i++)
    gradient[i] = distance > 1e-6f ? sign * (x[i] - point[i]) / distance : normal[i];
  return sign * distance;
}

// -------------------------------------------------------------------------------------------- grid

// Interpolates at eight points of b: distances, the node each cell begins at, and the gradients,
// unless NULL. Points outside are taken to the border, which lowers the distance: all of the border
// is farther than what matters.
static inline void plan_spheres_look(const plan_spheres_grid *g, const float (*x)[8], float *value,
                                     int *node, float (*gradient)[8]) {
  float f[3][8];
  int at[3][8];
  const float *v = g->value;
  const int row = g->size[0];
  const int layer = g->size[0] * g->size[1];
  for (int i = 0; i < 3; i++) {
    const float low = g->low[i];
    const float inverse = g->inverse[i];
    const float last = g->last[i];
    PLAN_SPHERES_EACH(k) {
      float u = (x[i][k] - low) * inverse;
      u = u < 0 ? 0 : u;
      u = u > last ? last : u;
      at[i][k] = (int)u;
      f[i][k] = u - (float)at[i][k];
    }
  }
  PLAN_SPHERES_EACH(k) node[k] = at[2][k] * layer + at[1][k] * row + at[0][k];
  float c[8][8];
  PLAN_SPHERES_EACH(k) {
    const float *p = v + node[k];
    c[0][k] = p[0];
    c[1][k] = p[1];
    c[2][k] = p[row];
    c[3][k] = p[row + 1];
    p += layer;
    c[4][k] = p[0];
    c[5][k] = p[1];
    c[6][k] = p[row];
    c[7][k] = p[row + 1];
  }
  PLAN_SPHERES_EACH(k) {
    float fx = f[0][k];
    float fy = f[1][k];
    float fz = f[2][k];
    float d0 = c[1][k] - c[0][k];
    float d1 = c[3][k] - c[2][k];
    float d2 = c[5][k] - c[4][k];
    float d3 = c[7][k] - c[6][k];
    float a0 = c[0][k] + fx * d0;
    float a1 = c[2][k] + fx * d1;
    float a2 = c[4][k] + fx * d2;
    float a3 = c[6][k] + fx * d3;
    float b0 = a0 + fy * (a1 - a0);
    float b1 = a2 + fy * (a3 - a2);
    value[k] = b0 + fz * (b1 - b0);
    if (!gradient) continue;
    float e0 = d0 + fy * (d1 - d0);
    float e1 = d2 + fy * (d3 - d2);
    gradient[0][k] = (e0 + fz * (e1 - e0)) * g->inverse[0];
    gradient[1][k] = (a1 - a0 + fz * (a3 - a2 - a1 + a0)) * g->inverse[1];
    gradient[2][k] = (b1 - b0) * g->inverse[2];
  }
}
static int plan_spheres_is_rough(const plan_spheres_grid *g, int node) {
  return g->rough[node >> 3] >> (node & 7) & 1;
}
static void plan_spheres_node(const plan_spheres_grid *g, size_t i, float shift, float *x) {
  size_t at[3];
  size_t nx = (size_t)g->size[0];
  size_t ny = (size_t)g->size[1];
  at[0] = i % nx;
  at[1] = i / nx % ny;
  at[2] = i / (nx * ny);
  for (int k = 0; k < 3; k++) x[k] = g->low[k] + ((float)at[k] + shift) * g->cell[k];
}
// Signed distances out to `reach`. Each node begins with what is known from the one before it.
static int plan_spheres_make_grid(plan_spheres_body *b, float reach) {
  plan_spheres_grid *g = &b->grid;
  const mesh_bvh *tree = b->fit->tree;
  float extent = 0;
  float known = 0;
  float x[3];
  float point[3];
  float normal[3];
  size_t total;
  for (int i = 0; i < 3; i++) extent = fmaxf(extent, 2 * tree->box.half[i]);
  // 1/64 of the body, but 1/16 of its thickness, and 2 mm at least.
  for (int i = 0; i < 3; i++) g->cell[i] = fmaxf(0.002f, fminf(extent / 64, tree->box.half[i] / 8));
  for (;;) {
    total = 1;
    g->bound = 0;
    for (int i = 0; i < 3; i++) g->bound += 0.25f * g->cell[i] * g->cell[i];
    g->bound = sqrtf(g->bound);  // half a diagonal: a distance changes by no more than the way
    for (int i = 0; i < 3; i++) {
      float pad = reach + g->cell[i];
      g->size[i] = (int)ceilf(2 * (tree->box.half[i] + pad) / g->cell[i]) + 1;
      g->low[i] = tree->box.centre[i] - 0.5f * (float)(g->size[i] - 1) * g->cell[i];
      g->inverse[i] = 1 / g->cell[i];
      g->last[i] = (float)(g->size[i] - 1) * 0.999999f;
      total *= (size_t)g->size[i];
    }
    if (total <= PLAN_SPHERES_NODES) break;
    for (int i = 0; i < 3; i++) g->cell[i] *= 1.05f;
  }
  g->value = (float *)malloc(total * sizeof(float));
  g->rough = (unsigned char *)calloc(total / 8 + 1, 1);
  if (!g->value || !g->rough) return 0;
  const float far = reach + 2 * g->bound;
  for (size_t i = 0; i < total; i++) {
    int follows = i % (size_t)g->size[0] > 0;
    float step = 1.0001f * g->cell[0];
    if (follows && known - step > far) {
      g->value[i] = known -= step;
      continue;
    }
    plan_spheres_node(g, i, 0, x);
    float limit = follows ? 1.01f * (fabsf(known) + step) : FLT_MAX;
    float d = sqrtf(spheres_nearest(tree, x, follows ? limit * limit : FLT_MAX, 0, NULL));
    int inside = follows && fabsf(known) > step ? known < 0 : spheres_inside(tree, x);
    g->value[i] = known = inside ? -d : d;
  }
  // The centres of cells.
  const size_t nx = (size_t)g->size[0];
  const size_t layer = nx * (size_t)g->size[1];
  for (size_t i = 0; i + layer + nx + 1 < total; i++) {
    const size_t corners[8] = {0, 1, nx, nx + 1, layer, layer + 1, layer + nx, layer + nx + 1};
    float mean = 0;
    float least = FLT_MAX;
    for (int k = 0; k < 8; k++) {
      mean += g->value[i + corners[k]] / 8;
      least = fminf(least, g->value[i + corners[k]]);
    }
    if (least > reach) continue;
    plan_spheres_node(g, i, 0.5f, x);
    // Nearer than what would do, farther than that, or of the other sign?
    float most = fabsf(mean) + PLAN_SPHERES_ERROR;
    float d = sqrtf(plan_spheres_nearest(tree, x, most * most, point, normal));
    int rough = d >= most || d < fabsf(mean) - PLAN_SPHERES_ERROR;
    if (!rough && fabsf(mean) <= g->bound && fabsf(mean) > PLAN_SPHERES_ERROR)
      rough = spheres_inside(tree, x) != (mean < 0);
    g->rough[i >> 3] |= (unsigned char)(rough << (i & 7));
  }
  return 1;
}

// ----------------------------------------------------------------------------------------- spheres

static float plan_spheres_area(const nsvcd_mesh *mesh) {
  double total = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const float *corner;
    float u[3], v[3];
    total += 0.5 * (double)spheres_edges(mesh, t, &corner, u, v);
  }
  return (float)total;
}
// Adds surface points until there are n spheres, each the candidate that is farthest from all
// spheres so far. Returns the greatest distance of a candidate that is left. gaps: (count).
static float plan_spheres_spread(spheres_body *b, const spheres_ball *candidates, size_t count,
                                 size_t n, float *gaps) {
  size_t done = 0;
  size_t farthest;
  for (size_t i = 0; i < count; i++) gaps[i] = FLT_MAX;
  for (;;) {
    for (; done < b->ball_count; done++) {
      const spheres_ball ball = b->balls[done];
      for (size_t i = 0; i < count; i++) {
        float x = candidates[i].centre[0] - ball.centre[0];
        float y = candidates[i].centre[1] - ball.centre[1];
        float z = candidates[i].centre[2] - ball.centre[2];
        float gap = sqrtf(x * x + y * y + z * z) - ball.radius;
        gaps[i] = gap < gaps[i] ? gap : gaps[i];
      }
    }
    farthest = 0;
    for (size_t i = 1; i < count; i++)
      if (gaps[i] > gaps[farthest]) farthest = i;
    if (b->ball_count >= n || !spheres_add(b, candidates[farthest].centre, SPHERES_SURFACE_RADIUS))
      break;
  }
  return gaps[farthest];
}
// The n spheres of a body.
static int plan_spheres_fit(spheres_body *b, const nsvcd_mesh *mesh, size_t n) {
  spheres_body points, best;
  size_t count = 2 * n > 1000 ? 2 * n : 1000;
  float *gaps = (float *)malloc(count * sizeof *gaps);
  float least = FLT_MAX;
  float extent = 0;
  float volume = 1;
  memset(&points, 0, sizeof points);
  memset(&best, 0, sizeof best);
  int ok = gaps && spheres_sample(&points, mesh, count);
  for (int i = 0; i < 3; i++) {
    extent = fmaxf(extent, 2 * b->tree->box.half[i]);
    volume *= 2 * b->tree->box.half[i];
  }
  for (float voxel = extent; ok && voxel > 0.001f && volume / (voxel * voxel * voxel) < 5e4f;
       voxel *= 0.7f) {
    size_t kept = 0;
    b->ball_count = 0;
    ok = spheres_fill(b, voxel);
    spheres_drop_contained(b, 0.1f * voxel);
    for (size_t i = 0; i < b->ball_count; i++)  // smaller than half a surface point: that does more
      if (b->balls[i].radius >= SPHERES_SURFACE_RADIUS / 2) b->balls[kept++] = b->balls[i];
    b->ball_count = kept;
    if (kept > 2 * n) break;
    if (4 * kept > 3 * n) continue;
    float gap = plan_spheres_spread(b, points.balls, count, n, gaps);
    if (gap >= least) continue;
    spheres_body other = best;
    least = gap;
    best = *b;
    b->balls = other.balls;
    b->ball_count = other.ball_count;
    b->ball_capacity = other.ball_capacity;
  }
  free(b->balls);
  free(points.balls);
  free(gaps);
  b->balls = best.balls;
  b->ball_count = best.ball_count;
  b->ball_capacity = best.ball_capacity;
  return ok && b->ball_count == n;
}
// Sorts balls so that eights, and eights of eights, are near each other.
static void plan_spheres_order(spheres_ball *balls, size_t count, mesh_bvh_key *keys,
                               spheres_ball *scratch) {
  if (count <= 8) return;
  spheres_sort(balls, count, keys, scratch);
  size_t part = 8;
  while (2 * part < count) part *= 2;  // full eights of eights of ... on the left
  plan_spheres_order(balls, part, keys, scratch);
  plan_spheres_order(balls + part, count - part, keys, scratch);
}
static plan_spheres_eight *plan_spheres_pack(const spheres_ball *balls, size_t count) {
  plan_spheres_eight *out = (plan_spheres_eight *)malloc((count + 7) / 8 * sizeof *out);
  for (size_t i = 0; out && i < (count + 7) / 8 * 8; i++) {
    const spheres_ball *ball = &balls[i < count ? i : count - 1];
    for (int k = 0; k < 3; k++) out[i / 8].centre[k][i % 8] = ball->centre[k];
    out[i / 8].radius[i % 8] = i < count ? ball->radius : -1e6f;
  }
  return out;
}
static int plan_spheres_make_body(plan_spheres_body *b, const nsvcd_mesh *mesh, size_t n) {
  if (!plan_spheres_fit(b->fit, mesh, n)) return 0;
  mesh_bvh_key *keys = (mesh_bvh_key *)malloc(n * sizeof *keys);
  spheres_ball *scratch = (spheres_ball *)malloc(n * sizeof *scratch);
  spheres_ball all;
  size_t eights = b->eight_count = (n + 7) / 8;
  if (keys && scratch) {
    plan_spheres_order(b->fit->balls, n, keys, scratch);
    b->eights = plan_spheres_pack(b->fit->balls, n);
    for (size_t i = 0; i < eights; i++)
      spheres_bound(b->fit->balls + 8 * i, 8 * i + 8 < n ? 8 : n - 8 * i, &scratch[i]);
    b->bounds = plan_spheres_pack(scratch, eights);
    spheres_bound(b->fit->balls, n, &all);
    memcpy(b->centre, all.centre, sizeof all.centre);
    b->radius = all.radius;
  }
  free(keys);
  free(scratch);
  return b->eights && b->bounds;
}

PLAN_SPHERES_DEF void plan_spheres_free(plan_spheres *s) {
  for (int i = 0; i < s->body_count; i++) {
    plan_spheres_body *b = &s->bodies[i];
    spheres_release(b->fit);
    free(b->eights);
    free(b->bounds);
    free(b->grid.value);
    free(b->grid.rough);
  }
  free(s->placed);
  memset(s, 0, sizeof *s);
}
// Spheres of all moving bodies of the scene, grasped ones in all of its problems. 0 without memory.
PLAN_SPHERES_DEF int plan_spheres_init(plan_spheres *s, const task_scene *scene,
                                       size_t robot_spheres, size_t held_spheres, float activation,
                                       float weight, int exact) {
  int measured[TASK_MAX_BODIES] = {0};
  int held[TASK_MAX_BODIES] = {0};
  int ok = 1;
  float area = 0;
  memset(s, 0, sizeof *s);
  s->activation = activation;
  s->weight = weight;
  s->exact = exact;
  s->body_count = scene->body_count;
  s->placed = (float *)malloc((size_t)s->body_count * PLAN_SPHERES_CHUNK * 15 * sizeof(float));
  for (int k = 0; k < scene->pair_count; k++) measured[scene->pairs[k][1]] = 1;
  for (int i = 0; i < scene->body_count; i++) held[i] = scene->bodies[i].kind == TASK_HELD;
  for (int k = 0; scene->problem_count > 1 && k < scene->problem_count; k++)
    held[scene->held[k]] = 1;
  for (int i = 0; i < scene->body_count; i++) {
    s->bodies[i].area = plan_spheres_area(&scene->bodies[i].mesh);
    if (scene->bodies[i].kind == TASK_ROBOT && measured[i]) area += s->bodies[i].area;
  }
  // What is left over by rounding goes to the next one.
  float passed = 0;
  size_t given = 0;
  for (int i = 0; i < scene->body_count && ok; i++) {
    const task_body *from = &scene->bodies[i];
    plan_spheres_body *b = &s->bodies[i];
    size_t n = held[i] ? held_spheres : 0;
    b->fit = (spheres_body *)calloc(1, sizeof *b->fit);
    if (b->fit) b->fit->tree = (mesh_bvh *)mesh_bvh_prepare(&from->mesh, NULL);
    ok = b->fit && b->fit->tree && s->placed;
    if (from->kind == TASK_ROBOT && measured[i]) {
      passed += b->area;
      n = (size_t)((double)robot_spheres * (double)passed / (double)area + 0.5) - given;
      given += n;
      n = n ? n : 1;
    }
    if (!ok || !n) continue;
    ok = spheres_make_grid(b->fit) && plan_spheres_make_body(b, &from->mesh, n);
    for (size_t k = 0; ok && k < b->fit->ball_count; k++)
      s->most_radius = fmaxf(s->most_radius, b->fit->balls[k].radius);
  }
  if (!ok) plan_spheres_free(s);
  return ok;
}
// The pairs of the selected problem, and the grids that they need. 0 without memory, or if a body
// that was in no pair when the spheres were made now needs some.
PLAN_SPHERES_DEF int plan_spheres_select(plan_spheres *s, const task_scene *scene) {
  s->pair_count = scene->pair_count;
  for (int i = 0; i < scene->body_count; i++) s->bodies[i].moves = task_moves(&scene->bodies[i]);
  for (int k = 0; k < scene->pair_count; k++) {
    int a = scene->pairs[k][1];
    int b = scene->pairs[k][0];
    const plan_spheres_body *of_a = &s->bodies[a];
    const plan_spheres_body *of_b = &s->bodies[b];
    int swap = of_b->moves && (float)of_b->fit->ball_count / of_b->area >
                                  (float)of_a->fit->ball_count / of_a->area;
    s->pairs[k][0] = swap ? b : a;
    s->pairs[k][1] = swap ? a : b;
    // a robot's body that was in no pair at first
    if (!s->bodies[s->pairs[k][0]].eight_count) return 0;
    plan_spheres_body *fixed = &s->bodies[s->pairs[k][1]];
    if (!fixed->grid.value && !plan_spheres_make_grid(fixed, s->activation + s->most_radius))
      return 0;
  }
  return 1;
}

// -------------------------------------------------------------------------------------------- cost

typedef struct plan_spheres_sum {
  float cost, force[3], moment[3];  // in the mesh's frame, about its origin
  int collides;
} plan_spheres_sum;

static void plan_spheres_matrix(const float *q, float *m) {
  float x = 2 * q[0];
  float y = 2 * q[1];
  float z = 2 * q[2];
  m[0] = 1 - y * q[1] - z * q[2];
  m[1] = x * q[1] - z * q[3];
  m[2] = x * q[2] + y * q[3];
  m[3] = x * q[1] + z * q[3];
  m[4] = 1 - x * q[0] - z * q[2];
  m[5] = y * q[2] - x * q[3];
  m[6] = x * q[2] - y * q[3];
  m[7] = y * q[2] + x * q[3];
  m[8] = 1 - x * q[0] - y * q[1];
}
static inline void plan_spheres_move(const transform *at, const plan_spheres_eight *eight,
                                     float (*x)[8]) {
  for (int i = 0; i < 3; i++) {
    const float *r = at->rotation + 3 * i;
    const float p = at->position[i];
    PLAN_SPHERES_EACH(k)
    x[i][k] =
        r[0] * eight->centre[0][k] + r[1] * eight->centre[1][k] + r[2] * eight->centre[2][k] + p;
  }
}
// Eight spheres against a mesh.
static inline void plan_spheres_add(plan_spheres *s, const plan_spheres_body *b,
                                    const transform *at, const plan_spheres_eight *eight,
                                    int derive, plan_spheres_sum *sum) {
  const plan_spheres_grid *g = &b->grid;
  const float e = s->activation;
  float x[3][8];
  float value[8];
  float gradient[3][8];
  float cost = 0;
  int node[8];
  unsigned near = 0;
  plan_spheres_move(at, eight, x);
  plan_spheres_look(g, (const float(*)[8])x, value, node, gradient);
  PLAN_SPHERES_EACH(k) near |= (unsigned)(value[k] - eight->radius[k] < e + g->bound) << k;
  s->tests += 8;
  unsigned left = near;
  for (int k = 0; left; k++, left >>= 1) {
    if (!(left & 1) || (!s->exact && !plan_spheres_is_rough(g, node[k]))) continue;
    float p[3] = {x[0][k], x[1][k], x[2][k]};
    float n[3] = {0, 0, 0};
    float sign = value[k] > g->bound ? 1.0f : value[k] < -g->bound ? -1.0f : 0.0f;
    value[k] = plan_spheres_measure(b, p, e + eight->radius[k], sign, n);
    for (int i = 0; i < 3; i++) gradient[i][k] = n[i];
    s->asked++;
  }
  if (!near) return;
  float slope[8];
  float inverse = 1 / e;
  int collides = 0;
  PLAN_SPHERES_EACH(k) {
    float d = value[k] - eight->radius[k];
    float in = e - d;
    in = in < 0 ? 0 : in;
    float out = in > e ? in - 0.5f * e : 0.5f * in * in * inverse;
    slope[k] = in > e ? 1 : in * inverse;
    cost += out;
    collides |= d < 0;
  }
  sum->cost += cost;
  sum->collides |= collides;
  if (!derive) return;
  float t[6] = {0, 0, 0, 0, 0, 0};
  PLAN_SPHERES_EACH(k) {
    float fx = -slope[k] * gradient[0][k];
    float fy = -slope[k] * gradient[1][k];
    float fz = -slope[k] * gradient[2][k];
    t[0] += fx;
    t[1] += fy;
    t[2] += fz;
    t[3] += x[1][k] * fz - x[2][k] * fy;
    t[4] += x[2][k] * fx - x[0][k] * fz;
    t[5] += x[0][k] * fy - x[1][k] * fx;
  }
  for (int i = 0; i < 3; i++) {
    sum->force[i] += t[i];
    sum->moment[i] += t[3 + i];
  }
}
// All spheres of a against b, of which a is seen `at`.
static void plan_spheres_meet(plan_spheres *s, const plan_spheres_body *a,
                              const plan_spheres_body *b, const transform *at, int derive,
                              plan_spheres_sum *sum) {
  const plan_spheres_grid *g = &b->grid;
  const mesh_bvh_box *box = &b->fit->tree->box;
  for (size_t i = 0; i < a->eight_count; i += 8) {
    const plan_spheres_eight *bound = &a->bounds[i / 8];
    float x[3][8], value[8], outside[8];
    int node[8];
    unsigned near = 0;
    plan_spheres_move(at, bound, x);
    plan_spheres_look(g, (const float(*)[8])x, value, node, NULL);
    s->tests += 8;
    PLAN_SPHERES_EACH(k) {
      float gap[3];
      for (int j = 0; j < 3; j++) {
        gap[j] = fabsf(x[j][k] - box->centre[j]) - box->half[j];
        gap[j] = gap[j] < 0 ? 0 : gap[j];
      }
      float reach = bound->radius[k] + s->activation;
      outside[k] =
          gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2] - (reach > 0 ? reach * reach : -1);
    }
    PLAN_SPHERES_EACH(k)
    near |= (unsigned)((outside[k] < 0) & (value[k] - g->bound < bound->radius[k] + s->activation))
            << k;
    for (int k = 0; near; k++, near >>= 1) {
      // Where interpolation is good, it need not be doubted by as much.
      float most = bound->radius[k] + s->activation + 4 * PLAN_SPHERES_ERROR;
      if (!(near & 1) || (value[k] > most && !plan_spheres_is_rough(g, node[k]))) continue;
      plan_spheres_add(s, b, at, &a->eights[i + (size_t)k], derive, sum);
    }
  }
}
static float *plan_spheres_placed(const plan_spheres *s, int body, size_t sample) {
  return s->placed +
         ((size_t)body * PLAN_SPHERES_CHUNK + (s->bodies[body].moves ? sample : 0)) * 15;
}
static void plan_spheres_place(plan_spheres *s, const nsvcd_pose *poses, size_t samples) {
  for (int i = 0; i < s->body_count; i++) {
    const plan_spheres_body *b = &s->bodies[i];
    // what stands still is where the first sample says
    for (size_t k = 0; k < (b->moves ? samples : 1); k++) {
      const nsvcd_pose *pose = &poses[k * (size_t)s->body_count + (size_t)i];
      const float *c = b->moves ? b->centre : b->fit->tree->box.centre;
      float *out = plan_spheres_placed(s, i, k);
      plan_spheres_matrix(pose->rotation, out);
      for (int j = 0; j < 3; j++) {
        out[9 + j] = pose->position[j];
        out[12 + j] = pose->position[j] + plan_spheres_dot(out + 3 * j, c);
      }
    }
  }
}
// From the mesh's frame to the world, and from b's origin to a's.
static void plan_spheres_push(const plan_spheres_sum *sum, const float *of_a, const float *of_b,
                              float weight, float *on_a, float *on_b) {
  float f[3], m[3], d[3], c[3];
  for (int i = 0; i < 3; i++) {
    f[i] = weight * plan_spheres_dot(of_b + 3 * i, sum->force);
    m[i] = weight * plan_spheres_dot(of_b + 3 * i, sum->moment);
    d[i] = of_b[9 + i] - of_a[9 + i];
  }
  mesh_bvh_cross(d, f, c);
  for (int i = 0; i < 3; i++) {
    on_a[i] += f[i];
    on_a[3 + i] += m[i] + c[i];
    on_b[i] -= f[i];
    on_b[3 + i] -= m[i];
  }
}
// One pair, up to CHUNK samples that are placed. Returns the cost.
static float plan_spheres_pair(plan_spheres *s, int ia, int ib, size_t samples, int *collides,
                               float *gradient) {
  const plan_spheres_body *a = &s->bodies[ia];
  const plan_spheres_body *b = &s->bodies[ib];
  const mesh_bvh_box *box = &b->fit->tree->box;
  const float reach = a->radius + s->activation;
  float low[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
  float high[3] = {FLT_MAX, FLT_MAX, FLT_MAX};
  float cost = 0;
  if (!b->moves) {  // its box in the world
    const float *m = plan_spheres_placed(s, ib, 0);
    for (int i = 0; i < 3; i++) {
      float half = reach;
      for (int k = 0; k < 3; k++) half += fabsf(m[3 * i + k]) * box->half[k];
      low[i] = m[12 + i] - half;
      high[i] = m[12 + i] + half;
    }
  }
  for (size_t n = 0; n < samples; n++) {
    const float *p = plan_spheres_placed(s, ia, n);
    const float *q = plan_spheres_placed(s, ib, n);
    plan_spheres_sum sum = {0, {0, 0, 0}, {0, 0, 0}, 0};
    transform at;
    float d[3];
    float outside = 0;
    if ((p[12] < low[0]) | (p[12] > high[0]) | (p[13] < low[1]) | (p[13] > high[1]) |
        (p[14] < low[2]) | (p[14] > high[2]))
      continue;
    for (int i = 0; i < 3; i++) d[i] = p[12 + i] - q[9 + i];
    for (int i = 0; i < 3; i++) {
      float gap =
          fabsf(q[i] * d[0] + q[3 + i] * d[1] + q[6 + i] * d[2] - box->centre[i]) - box->half[i];
      outside += gap > 0 ? gap * gap : 0;
    }
    if (outside >= reach * reach) continue;
    for (int i = 0; i < 3; i++) d[i] = p[9 + i] - q[9 + i];
    for (int i = 0; i < 3; i++) {
      at.position[i] = q[i] * d[0] + q[3 + i] * d[1] + q[6 + i] * d[2];
      for (int k = 0; k < 3; k++)
        at.rotation[3 * i + k] = q[i] * p[k] + q[3 + i] * p[3 + k] + q[6 + i] * p[6 + k];
    }
    plan_spheres_meet(s, a, b, &at, gradient != NULL, &sum);
    cost += sum.cost;
    *collides |= sum.collides;
    if (!gradient || !(sum.cost > 0)) continue;
    float *row = gradient + 6 * n * (size_t)s->body_count;
    plan_spheres_push(&sum, p, q, s->weight, row + 6 * ia, row + 6 * ib);
  }
  return cost;
}
// nsvcd_plan_problem.collision, but for `user`. collides: set to 1 if so, else left alone.
PLAN_SPHERES_DEF float plan_spheres_cost(plan_spheres *s, const nsvcd_pose *poses, size_t samples,
                                         float limit, int *collides, float *gradient) {
  double begin = seconds();
  double cost = 0;
  for (size_t first = 0; first < samples; first += PLAN_SPHERES_CHUNK) {
    size_t left = samples - first;
    size_t count = left < PLAN_SPHERES_CHUNK ? left : (size_t)PLAN_SPHERES_CHUNK;
    size_t row = first * (size_t)s->body_count;
    plan_spheres_place(s, poses + row, count);
    for (int k = 0; k < s->pair_count && s->weight * (float)cost <= limit; k++)
      cost += (double)plan_spheres_pair(s, s->pairs[k][0], s->pairs[k][1], count, collides,
                                        gradient ? gradient + 6 * row : NULL);
  }
  s->calls++;
  s->seconds += seconds() - begin;
  return s->weight * (float)cost;
}

#endif  // NSVCD_BENCH_PLAN_SPHERES_H
