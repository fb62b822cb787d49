// What the proof needs of each patch: balls, discs, hulls, triangles. The reference is double
// precision, written apart, and knows nothing of pieces: it takes points of the mesh and looks
// where the result says they are.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/body/encode.h"

#include "check.h"
#include "failing_heap.h"
#include "surface_scene.h"

#include <stdio.h>
#include <stdlib.h>

void test_surface(void);

static nsvcd__d3 surface_corner(const nsvcd_mesh *mesh, size_t t, size_t i) {
  return nsvcd__d3_load(mesh->positions + 3 * (size_t)mesh->indices[3 * t + i]);
}

// --------------------------------------------------------------------------------------- distances

static double segment_distance(nsvcd__d3 a, nsvcd__d3 b, nsvcd__d3 x) {
  const nsvcd__d3 d = nsvcd__d3_sub(b, a);
  const double squared = nsvcd__d3_dot(d, d);
  const double t =
      squared > 0 ? fmin(1, fmax(0, nsvcd__d3_dot(nsvcd__d3_sub(x, a), d) / squared)) : 0;
  return nsvcd__d3_norm(nsvcd__d3_sub(nsvcd__d3_add(a, nsvcd__d3_scale(d, t)), x));
}

static double triangle_distance(const nsvcd__d3 *c, nsvcd__d3 x) {
  double least = segment_distance(c[0], c[1], x);
  least = fmin(least, segment_distance(c[1], c[2], x));
  least = fmin(least, segment_distance(c[2], c[0], x));
  const nsvcd__d3 n = nsvcd__d3_cross(nsvcd__d3_sub(c[1], c[0]), nsvcd__d3_sub(c[2], c[0]));
  if (!(nsvcd__d3_norm(n) > 0)) return least;
  for (size_t i = 0; i < 3; i++) {
    const nsvcd__d3 side = nsvcd__d3_cross(n, nsvcd__d3_sub(c[(i + 1) % 3], c[i]));
    if (nsvcd__d3_dot(side, nsvcd__d3_sub(x, c[i])) < 0) return least;
  }
  return fmin(least, fabs(nsvcd__d3_dot(n, nsvcd__d3_sub(x, c[0]))) / nsvcd__d3_norm(n));
}

// From outside, the nearest point of a hull lies in a triangle of its vertices: tries them all.
static int any_triangle_reaches(const nsvcd__d3 *points, size_t count, nsvcd__d3 x, double reach) {
  for (size_t i = 0; i < count; i++) {
    for (size_t j = i; j < count; j++) {
      for (size_t k = j; k < count; k++) {
        const nsvcd__d3 corners[3] = {points[i], points[j], points[k]};
        if (triangle_distance(corners, x) <= reach) return 1;
      }
    }
  }
  return 0;
}

// Within the hull a point is in a tetrahedron of vertices. Flat ones do not count: triangles tell.
static int in_tetrahedron(nsvcd__d3 a, nsvcd__d3 b, nsvcd__d3 c, nsvcd__d3 d, nsvcd__d3 x) {
  const nsvcd__d3 p = nsvcd__d3_sub(a, x);
  const nsvcd__d3 q = nsvcd__d3_sub(b, x);
  const nsvcd__d3 r = nsvcd__d3_sub(c, x);
  const nsvcd__d3 s = nsvcd__d3_sub(d, x);
  const double parts[4] = {
      nsvcd__d3_dot(q, nsvcd__d3_cross(r, s)), -nsvcd__d3_dot(p, nsvcd__d3_cross(r, s)),
      nsvcd__d3_dot(p, nsvcd__d3_cross(q, s)), -nsvcd__d3_dot(p, nsvcd__d3_cross(q, r))};
  const double base = nsvcd__d3_norm(nsvcd__d3_sub(b, a)) * nsvcd__d3_norm(nsvcd__d3_sub(c, a));
  const double size = base * nsvcd__d3_norm(nsvcd__d3_sub(d, a));
  const double whole = parts[0] + parts[1] + parts[2] + parts[3];
  if (fabs(whole) <= 1e-12 * size) return 0;
  for (size_t i = 0; i < 4; i++) {
    if (parts[i] / whole < 0) return 0;
  }
  return 1;
}
static int any_tetrahedron_holds(const nsvcd__d3 *points, size_t count, nsvcd__d3 x) {
  for (size_t i = 0; i < count; i++) {
    for (size_t j = i + 1; j < count; j++) {
      for (size_t k = j + 1; k < count; k++) {
        for (size_t l = k + 1; l < count; l++) {
          if (in_tetrahedron(points[i], points[j], points[k], points[l], x)) return 1;
        }
      }
    }
  }
  return 0;
}

// Is x within `reach` of the convex hull of these points? A few of Frank and Wolfe's steps settle
// most: a point of the hull is that near, or a plane shows that none is. The rest is tried out.
static int hull_reaches(const nsvcd__d3 *points, size_t count, nsvcd__d3 x, double reach) {
  double weights[NSVCD__HULL] = {1};
  nsvcd__d3 v = nsvcd__d3_sub(points[0], x);
  for (int step = 0; step < 60; step++) {
    const double squared = nsvcd__d3_dot(v, v);
    if (squared <= reach * reach) return 1;
    size_t to = 0;
    size_t from = 0;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
      const double at = nsvcd__d3_dot(nsvcd__d3_sub(points[i], x), v);
      if (at < least) to = i;
      if (at > most && weights[i] > 0) from = i;
      least = fmin(least, at);
      if (weights[i] > 0) most = fmax(most, at);
    }
    if (least > reach * sqrt(squared)) return 0;
    const nsvcd__d3 d = nsvcd__d3_sub(points[to], points[from]);
    const double way = -nsvcd__d3_dot(v, d) / nsvcd__d3_dot(d, d);
    if (!(way > 0)) break;
    const double fraction = fmin(way, weights[from]);
    weights[from] -= fraction;
    weights[to] += fraction;
    v = nsvcd__d3_of(0, 0, 0);
    for (size_t i = 0; i < count; i++)
      v = nsvcd__d3_add(v, nsvcd__d3_scale(nsvcd__d3_sub(points[i], x), weights[i]));
  }
  return any_triangle_reaches(points, count, x, reach) || any_tetrahedron_holds(points, count, x);
}

// ------------------------------------------------------------------------------ reading the result

typedef struct reader {
  const nsvcd_mesh *mesh;
  nsvcd__arena arena;
  nsvcd__surface surface;
  // mean of the patches that it is made from; 0 where there are several regions
  double patch_radius;
  nsvcd__d3 *vertices;  // patch by patch: points stored as integers, then vertices named
  size_t *listings;     // (T + 1) listings of a triangle
  uint32_t *sorted;     // (L) by triangle
  uint32_t *patch;      // (L) of a entry
  double tolerance;     // 1e-12 of the greatest coordinate: of this test's own roundings
} reader;

static uint32_t reader_id(const reader *r, size_t entry) {
  return r->surface.ids[entry] & NSVCD__NUMBER;
}

// Where the points of a patch begin.
static size_t reader_first(const nsvcd__surface *s, size_t patch) {
  return (size_t)s->patches[patch].first_vertex + s->patches[patch].first_named;
}

static void reader_index(reader *r) {
  const nsvcd__surface *s = &r->surface;
  r->vertices = (nsvcd__d3 *)malloc((s->vertex_count + s->named_count) * sizeof(nsvcd__d3));
  r->listings = (size_t *)calloc(r->mesh->triangle_count + 1, sizeof(size_t));
  r->sorted = (uint32_t *)malloc(4 * s->listed);
  r->patch = (uint32_t *)malloc(4 * s->listed);
  for (uint32_t i = 0; i < s->count; i++) {
    nsvcd__d3 *points = r->vertices + reader_first(s, i);
    const size_t n = s->patches[i + 1].first_vertex - s->patches[i].first_vertex;
    const int16_t *q = s->vertices + 3 * (size_t)s->patches[i].first_vertex;
    for (size_t j = 0; j < n; j++) {
      const nsvcd__d3 offset = nsvcd__d3_of(q[j], q[n + j], q[2 * n + j]);
      const nsvcd__d3 centre = nsvcd__d3_load(&s->patches[i].ball.centre.x);
      *points++ = nsvcd__d3_add(centre, nsvcd__d3_scale(offset, (double)s->patches[i].step));
    }
    for (size_t j = s->patches[i].first_named; j < s->patches[i + 1].first_named; j++)
      *points++ = nsvcd__d3_load(r->mesh->positions + 3 * (size_t)s->named[j]);
    for (size_t l = s->patches[i].first_triangle; l < s->patches[i + 1].first_triangle; l++) {
      r->patch[l] = i;
      r->listings[reader_id(r, l)]++;
    }
  }
  for (size_t t = 1; t <= r->mesh->triangle_count; t++) r->listings[t] += r->listings[t - 1];
  for (size_t l = s->listed; l-- > 0;) r->sorted[--r->listings[reader_id(r, l)]] = (uint32_t)l;
}

// The surface of a mesh, as nsvcd_encode makes it. On success release the arena.
static nsvcd_result surface_of(const nsvcd_mesh *mesh, size_t points,
                               const nsvcd_allocator *allocator, nsvcd__arena *arena,
                               nsvcd__surface *surface) {
  nsvcd_encode_options options;
  nsvcd__draft draft;
  memset(&options, 0, sizeof options);
  options.patches = points;
  const nsvcd_result result = nsvcd__draft_build(mesh, &options, allocator, &draft);
  if (result) return result;
  *surface = draft.surface;
  *arena = draft.arena;
  return NSVCD_OK;
}

static int reader_open(reader *r, const nsvcd_mesh *mesh, size_t points) {
  memset(r, 0, sizeof *r);
  r->mesh = mesh;
  r->tolerance = 1e-12 * surface_scale(mesh);
  if (points <= NSVCD_SMALL_PATCHES) {
    nsvcd__patches patches;
    nsvcd__arena arena = nsvcd__arena_of(NULL);
    CHECK_EQ(nsvcd__patches_build(mesh, points, 1, &arena, &patches), NSVCD_OK);
    for (size_t i = 0; i < patches.count; i++)
      r->patch_radius += (double)patches.radii[i] / (double)patches.count;
    nsvcd__arena_free(&arena);
  }
  const nsvcd_result result = surface_of(mesh, points, NULL, &r->arena, &r->surface);
  CHECK_EQ(result, NSVCD_OK);
  return result == NSVCD_OK;
}

static void reader_close(reader *r) {
  nsvcd__arena_free(&r->arena);
  free(r->vertices);
  free(r->listings);
  free(r->sorted);
  free(r->patch);
}

static void reader_corners(const reader *r, size_t entry, nsvcd__d3 *corners) {
  const nsvcd__surface *s = &r->surface;
  for (size_t k = 0; k < 3; k++) {
    const size_t number = s->corners[3 * entry + k];
    corners[k] = r->vertices[reader_first(s, r->patch[entry]) + number];
  }
}

// Everything in its range; 0 if following the numbers would leave the arrays.
static int check_ranges(const reader *r) {
  const nsvcd__surface *s = &r->surface;
  size_t bad = 0;
  CHECK_EQ(s->patches[0].first_vertex, 0);
  CHECK_EQ(s->patches[0].first_triangle, 0);
  CHECK_EQ(s->patches[s->count].first_vertex, s->vertex_count);
  CHECK_EQ(s->patches[s->count].first_triangle, s->listed);
  CHECK_EQ(s->patches[0].first_named, 0);
  CHECK_EQ(s->patches[s->count].first_named, s->named_count);
  for (size_t n = 0; n < s->named_count; n++) bad += s->named[n] >= r->mesh->vertex_count;
  for (size_t i = 0; i < 3 * s->vertex_count; i++) bad += s->vertices[i] < -32767;
  for (size_t i = 0; i < s->count; i++) {
    const float *ball = &s->patches[i].ball.centre.x;
    const float *disc = &s->patches[i].slab.normal.x;
    bad += s->patches[i].first_vertex > s->patches[i + 1].first_vertex;
    bad += s->patches[i].first_triangle > s->patches[i + 1].first_triangle;
    const size_t n = s->patches[i + 1].first_vertex - s->patches[i].first_vertex;
    const size_t l = s->patches[i + 1].first_triangle - s->patches[i].first_triangle;
    const int empty = l == 0;
    bad += empty ? s->patches[i].hull_count != 0 || n != 0 || ball[3] != NSVCD__NOWHERE : 0;
    for (size_t k = 0; k < 4; k++) bad += !nsvcd__is_finite(ball[k]);
    for (size_t k = 0; k < 6; k++) bad += !nsvcd__is_finite(disc[k]);
    if (empty) continue;
    const nsvcd__d3 normal = nsvcd__d3_load(disc);
    bad += s->patches[i].hull_count < 1 || s->patches[i].hull_count > NSVCD__HULL ||
           s->patches[i].hull_count > n;
    bad += nsvcd__d3_norm(normal) > 1 || nsvcd__d3_norm(normal) < 1 - 1e-6;
    bad += !(ball[3] > 0) || !(s->patches[i].step > 0) || !(s->patches[i].margin > 0) ||
           !(s->patches[i].error >= 0);
    const size_t named = s->patches[i + 1].first_named - s->patches[i].first_named;
    size_t stored = 0;
    bad += !(disc[3] <= disc[4]) || !(disc[5] >= 0);
    for (size_t k = 3 * s->patches[i].first_triangle; k < 3 * s->patches[i + 1].first_triangle;
         k++) {
      bad += s->corners[k] >= n + named;
      stored += s->corners[k] < n;
    }
    // what is the caller's own is exact
    bad += stored ? !(s->patches[i].error > 0) : s->patches[i].error > 0;
  }
  for (size_t l = 0; l < s->listed; l++) bad += reader_id(r, l) >= r->mesh->triangle_count;
  CHECK_EQ(bad, 0);
  return bad == 0;
}

// Do ball, disc and hull of the patch contain x? Counts what does not.
typedef struct misses {
  size_t points, triangle, ball, disc, hull, nowhere;
} misses;

static int patch_holds(const reader *r, size_t i, nsvcd__d3 x, misses *m) {
  const nsvcd__surface *s = &r->surface;
  const float *ball = &s->patches[i].ball.centre.x;
  const float *disc = &s->patches[i].slab.normal.x;
  const nsvcd__d3 offset = nsvcd__d3_sub(x, nsvcd__d3_load(ball));
  if (nsvcd__d3_norm(offset) > (double)ball[3] + r->tolerance) {
    m->ball++;
    return 0;
  }
  const nsvcd__d3 normal = nsvcd__d3_load(disc);
  const double along = nsvcd__d3_dot(offset, normal);
  const double across = nsvcd__d3_norm(nsvcd__d3_cross(offset, normal)) / nsvcd__d3_norm(normal);
  if (along < (double)disc[3] - r->tolerance || along > (double)disc[4] + r->tolerance ||
      across > (double)disc[5] + r->tolerance) {
    m->disc++;
    return 0;
  }
  const nsvcd__d3 *hull = r->vertices + reader_first(s, i);
  const double reach = (double)s->patches[i].margin + r->tolerance;
  if (hull_reaches(hull, s->patches[i].hull_count, x, reach)) return 1;
  m->hull++;
  return 0;
}

// A point of triangle t: some patch lists a triangle with this id that is here, and holds the
// point.
static void check_point(const reader *r, size_t t, nsvcd__d3 x, misses *m) {
  int listed = 0;
  misses tried = *m;
  m->points++;
  for (size_t k = r->listings[t]; k < r->listings[t + 1]; k++) {
    const size_t l = r->sorted[k];
    nsvcd__d3 corners[3];
    reader_corners(r, l, corners);
    const double quantum = (double)r->surface.patches[r->patch[l]].error;
    // Tolerances in the triangle's own plane are only as good as its shape.
    const double rounding = 1e-6 * (double)r->surface.patches[r->patch[l]].ball.radius;
    if (triangle_distance(corners, x) > quantum + rounding + 10 * r->tolerance) continue;
    listed = 1;
    if (patch_holds(r, r->patch[l], x, &tried)) return;
  }
  *m = tried;
  m->points++;
  m->triangle += !listed;
  m->nowhere++;
}

static void check_points(const reader *r, shapes_rng *rng, size_t random) {
  misses m;
  memset(&m, 0, sizeof m);
  for (size_t t = 0; t < r->mesh->triangle_count; t++) {
    nsvcd__d3 c[3];
    for (size_t i = 0; i < 3; i++) c[i] = surface_corner(r->mesh, t, i);
    for (size_t i = 0; i < 3; i++) {
      const double fraction = shapes_uniform(rng, 0, 1);
      const nsvcd__d3 along = nsvcd__d3_scale(nsvcd__d3_sub(c[(i + 1) % 3], c[i]), fraction);
      check_point(r, t, c[i], &m);
      check_point(r, t, nsvcd__d3_add(c[i], along), &m);
    }
    for (size_t k = 0; k < random; k++) {
      double u = shapes_uniform(rng, 0, 1);
      double v = shapes_uniform(rng, 0, 1);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const nsvcd__d3 across = nsvcd__d3_scale(nsvcd__d3_sub(c[2], c[0]), v);
      const nsvcd__d3 x =
          nsvcd__d3_add(c[0], nsvcd__d3_add(nsvcd__d3_scale(nsvcd__d3_sub(c[1], c[0]), u), across));
      check_point(r, t, x, &m);
    }
  }
  CHECK_EQ(m.nowhere, 0);
  if (m.nowhere == 0) return;
  printf("  of %zu points: no triangle %zu; ", m.points, m.triangle);
  printf("left out by balls %zu, discs %zu, hulls %zu\n", m.ball, m.disc, m.hull);
}

// Vertices of whole triangles are within the quantum of the mesh's; what is listed lies within it
// of its triangle.
static void check_quanta(const reader *r) {
  size_t bad = 0;
  for (size_t l = 0; l < r->surface.listed; l++) {
    nsvcd__d3 corners[3];
    nsvcd__d3 mesh_corners[3];
    const size_t t = reader_id(r, l);
    const double quantum =
        (double)r->surface.patches[r->patch[l]].error * (1 + 1e-6) + 10 * r->tolerance;
    reader_corners(r, l, corners);
    for (size_t i = 0; i < 3; i++) mesh_corners[i] = surface_corner(r->mesh, t, i);
    for (size_t i = 0; i < 3; i++) bad += triangle_distance(mesh_corners, corners[i]) > quantum;
  }
  CHECK_EQ(bad, 0);
}

static nsvcd__d3 area_vector(const nsvcd__d3 *c) {
  return nsvcd__d3_scale(nsvcd__d3_cross(nsvcd__d3_sub(c[1], c[0]), nsvcd__d3_sub(c[2], c[0])),
                         0.5);
}

// Does a entry of the same triangle before number k list the same corners? Halves of large
// triangles, whole where several patches share them.
static int is_listed_before(const reader *r, size_t first, size_t k) {
  nsvcd__d3 own[3];
  reader_corners(r, r->sorted[k], own);
  const double quantum = (double)r->surface.patches[r->patch[r->sorted[k]]].error;
  for (size_t i = first; i < k; i++) {
    nsvcd__d3 other[3];
    double most = 0;
    reader_corners(r, r->sorted[i], other);
    const double both = quantum + (double)r->surface.patches[r->patch[r->sorted[i]]].error;
    for (size_t j = 0; j < 3; j++)
      most = fmax(most, nsvcd__d3_norm(nsvcd__d3_sub(own[j], other[j])));
    if (most <= both + 10 * r->tolerance) return 1;
  }
  return 0;
}

// The listings that enclose are those of closed components, and each triangle is there whole, or
// all of its parts are: per triangle the vector of areas, over all of them the volume.
static void check_enclosing(const reader *r) {
  const nsvcd_mesh *mesh = r->mesh;
  shells parts = shells_of(mesh);
  size_t bad = 0;
  size_t marked = 0;
  double volume = 0;
  double volume_error = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    nsvcd__d3 c[3];
    for (size_t i = 0; i < 3; i++) c[i] = surface_corner(mesh, t, i);
    const double size =
        nsvcd__d3_norm(nsvcd__d3_sub(c[1], c[0])) + nsvcd__d3_norm(nsvcd__d3_sub(c[2], c[0]));
    const int closed = parts.closed[parts.part[mesh->indices[3 * t]]];
    nsvcd__d3 sum = closed ? nsvcd__d3_scale(area_vector(c), -1) : nsvcd__d3_of(0, 0, 0);
    double error = 100 * r->tolerance * size;
    size_t found = 0;
    volume -= closed ? nsvcd__d3_dot(c[0], nsvcd__d3_cross(c[1], c[2])) / 6 : 0;
    const double before = volume;
    size_t flags = 0;
    int whole = 0;
    for (size_t k = r->listings[t]; k < r->listings[t + 1] && !whole; k++) {
      const size_t l = r->sorted[k];
      nsvcd__d3 part[3];
      flags += r->surface.ids[l] >> NSVCD__KIND_SHIFT >= NSVCD__CLOSED;
      if (!closed || is_listed_before(r, r->listings[t], k)) continue;
      reader_corners(r, l, part);
      const double quantum = (double)r->surface.patches[r->patch[l]].error;
      const double perimeter = nsvcd__d3_norm(nsvcd__d3_sub(part[1], part[0])) +
                               nsvcd__d3_norm(nsvcd__d3_sub(part[2], part[1])) +
                               nsvcd__d3_norm(nsvcd__d3_sub(part[0], part[2]));
      const double part_error = perimeter * quantum + 4 * quantum * quantum;
      const double part_volume = nsvcd__d3_dot(part[0], nsvcd__d3_cross(part[1], part[2])) / 6;
      const nsvcd__d3 rest = nsvcd__d3_sub(area_vector(part), area_vector(c));
      whole = nsvcd__d3_norm(rest) <= part_error + 100 * r->tolerance * size;
      if (whole) {  // it stands for all the others
        sum = rest;
        error = 100 * r->tolerance * size;
        volume = before;
      } else {
        sum = nsvcd__d3_add(sum, area_vector(part));
      }
      error += part_error;
      volume += part_volume;
      found++;
    }
    if (closed && !whole) bad += flags != r->listings[t + 1] - r->listings[t];
    if (!closed) found = flags;
    bad += nsvcd__d3_norm(sum) > error;
    bad += closed ? found == 0 : found > 0;
    marked += found > 0;
    volume_error += error * surface_scale(mesh) * 2 + 1e-15 * pow(surface_scale(mesh), 3);
  }
  CHECK_EQ(bad, 0);
  CHECK_LE(fabs(volume), volume_error);
  if (bad) printf("  %zu of %zu triangles enclose\n", marked, mesh->triangle_count);
  shells_free(&parts);
}

static void check_seeds(const reader *r) {
  const nsvcd_mesh *mesh = r->mesh;
  const nsvcd__surface *s = &r->surface;
  shells parts = shells_of(mesh);
  uint8_t *taken = (uint8_t *)calloc(mesh->vertex_count, 1);
  uint8_t *used = (uint8_t *)calloc(mesh->vertex_count, 1);
  CHECK_EQ(s->seed_count, parts.count);
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) used[mesh->indices[i]] = 1;
  for (size_t k = 0; k < s->seed_count; k++) {
    size_t v = 0;
    const float *seed = &s->seeds[k].x;
    for (; v < mesh->vertex_count; v++) {
      const float *p = mesh->positions + 3 * v;
      if (used[v] && p[0] == seed[0] && p[1] == seed[1] && p[2] == seed[2]) break;
    }
    CHECK(v < mesh->vertex_count);
    if (v == mesh->vertex_count) break;
    CHECK(!taken[parts.part[v]]);
    taken[parts.part[v]] = 1;
  }
  free(taken);
  free(used);
  shells_free(&parts);
}

static void check_all(const nsvcd_mesh *mesh, size_t points, shapes_rng *rng, size_t random) {
  reader r;
  const int failures = check.failures_in_test;
  if (!reader_open(&r, mesh, points)) return;
  if (check_ranges(&r)) {
    reader_index(&r);
    check_points(&r, rng, random);
    check_quanta(&r);
    check_enclosing(&r);
    check_seeds(&r);
  }
  reader_close(&r);
  if (check.failures_in_test > failures) {
    printf("  %zu triangles, %zu patches\n", mesh->triangle_count, points);
  }
}

// ------------------------------------------------------------------------------------------- tests

// Each kind with one patch, with a number of its own out of these, and in several regions. With
// TEST_MANY all.
static const size_t surface_points[8] = {1, 2, 17, 64, 256, 512, 513, 2100};

static void surface_is_covered(void) {
  shapes_rng rng = {1};
  for (int kind = 0; kind < SURFACE_KINDS; kind++) {
    nsvcd_mesh mesh = surface_kind(kind);
    const size_t random = 3 + 2000 / mesh.triangle_count;
    const int failures = check.failures_in_test;
    for (size_t n = 0; n < 8; n++) {
      const int is_its_own = n == 1 + (size_t)kind % 6 || n == 7 * ((size_t)kind % 2);
      if (is_its_own || check_many(1) > 1) check_all(&mesh, surface_points[n], &rng, random);
    }
    if (check.failures_in_test > failures) printf("  kind %d\n", kind);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

// Fine meshes are hardly cut, their triangles listed about once, and the hulls are near to the
// surface.
static void surface_of_a_fine_mesh(void) {
  shapes_rng rng = {2};
  nsvcd_mesh mesh = surface_sphere(0.5, 166);
  reader r;
  CHECK_LE(20000, mesh.triangle_count);
  check_all(&mesh, 256, &rng, 1);
  if (check_many(1) > 1) check_all(&mesh, 1, &rng, 1);
  CHECK(reader_open(&r, &mesh, 256));
  const nsvcd__surface *s = &r.surface;
  double slack = 0;
  double thickness = 0;
  double radius = 0;
  for (size_t i = 0; i < s->count; i++) {
    const double fraction = 1 / (double)s->count;
    const double own = (double)s->patches[i].ball.radius;
    const double thick = (double)(s->patches[i].slab.high - s->patches[i].slab.low);
    slack += fraction * (double)s->patches[i].margin / own;
    thickness += fraction * thick / own;
    radius += fraction * own;
  }
  CHECK_LE((double)s->listed, 1.15 * (double)mesh.triangle_count);
  CHECK_LE(slack, 0.03);
  CHECK_LE(thickness, 0.12);
  CHECK_LE(radius, 1.05 * r.patch_radius);
  CHECK_EQ(s->seed_count, 1);
  reader_close(&r);
  nsvcd_mesh_free(&mesh, NULL);
}

// Large faces are cut: balls are about as small as those of the patches, hulls of flat patches fit,
// the integers are fine.
static void surface_of_large_faces(void) {
  for (int kind = 0; kind < 2; kind++) {
    nsvcd_mesh mesh = kind ? surface_kind(3) : surface_box(0.4, 0.3, 0.2, 1);
    reader r;
    CHECK(reader_open(&r, &mesh, 256));
    double radius = 0;
    for (size_t i = 0; i < r.surface.count; i++) {
      radius += (double)r.surface.patches[i].ball.radius / (double)r.surface.count;
      CHECK_LE(r.surface.patches[i].margin, 1e-3f * r.surface.patches[i].ball.radius);
      CHECK_LE(r.surface.patches[i].error, 1e-3f * r.surface.patches[i].ball.radius);
    }
    CHECK_LE(radius, 1.1 * r.patch_radius);
    reader_close(&r);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

// Against Badoiu and Clarkson's steps, which come within 1 / steps of the least ball.
static void surface_balls_are_minimal(void) {
  shapes_rng rng = {9};
  for (size_t trial = 0; trial < 200; trial++) {
    nsvcd__d3 points[40];
    const size_t count = 1 + trial % 40;
    for (size_t i = 0; i < count; i++) {
      points[i] = nsvcd__d3_of(shapes_uniform(&rng, -1, 1), shapes_uniform(&rng, -1, 1),
                               trial % 3 ? shapes_uniform(&rng, -1, 1) : 0.25);
      if (trial % 7 == 0 && i > 3) points[i] = points[i / 2];
    }
    const nsvcd__points all = {points, count};
    const nsvcd__d3 centre = nsvcd__ball_centre(all);
    nsvcd__d3 other = points[0];
    double radius = 0;
    double least = HUGE_VAL;
    for (size_t i = 0; i < count; i++)
      radius = fmax(radius, nsvcd__d3_distance2(points[i], centre));
    for (size_t step = 1; step < 5000; step++) {
      size_t farthest = 0;
      for (size_t i = 0; i < count; i++) {
        if (nsvcd__d3_distance2(points[i], other) > nsvcd__d3_distance2(points[farthest], other))
          farthest = i;
      }
      least = fmin(least, nsvcd__d3_distance2(points[farthest], other));
      other = nsvcd__d3_mix(other, points[farthest], 1 / (double)(step + 1));
    }
    CHECK_LE(sqrt(radius), sqrt(least) * (1 + 1e-9) + 1e-12);
  }
}

// More vertices in a patch than 16 bits can name: refused, with nothing left behind.
static void surface_too_large(void) {
  nsvcd_mesh mesh = surface_sheet(260, 1, 0);
  nsvcd__surface surface;
  nsvcd__arena arena;
  failing_heap heap = {0, 0, -1};
  const nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, &heap};
  CHECK_EQ(surface_of(&mesh, 1, &allocator, &arena, &surface), NSVCD_ERROR_TOO_LARGE);
  CHECK_EQ(heap.live, 0);
  nsvcd_mesh_free(&mesh, NULL);
}

void test_surface(void) {
  RUN(surface_is_covered);
  RUN(surface_of_a_fine_mesh);
  RUN(surface_of_large_faces);
  RUN(surface_balls_are_minimal);
  RUN(surface_too_large);
}

CHECK_ALONE(test_surface)
