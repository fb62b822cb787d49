// Shapes that a game brings. Hulls: does any point lie outside, and is the mesh closed? Exactly for
// whole numbers, else by distances in double. Height fields: are they where the samples say?
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "mesh_of.h"
#include "check.h"

void test_shapes(void);

// ---- hulls

// Is each directed edge there once, and its reverse too, and is it one surface without handles?
static int hull_is_closed(const nsvcd_mesh *mesh) {
  const size_t edges = 3 * mesh->triangle_count;
  int is_closed = 2 * mesh->vertex_count == mesh->triangle_count + 4;
  size_t *first = (size_t *)calloc(mesh->vertex_count + 1, sizeof *first);
  uint32_t *to = (uint32_t *)malloc(edges * sizeof *to);
  for (size_t i = 0; i < edges; i++) first[mesh->indices[i] + 1]++;
  for (size_t i = 0; i < mesh->vertex_count; i++) first[i + 1] += first[i];
  memset(to, 0xff, edges * sizeof *to);
  for (size_t i = 0; i < edges; i++) {
    const uint32_t b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
    size_t at = first[mesh->indices[i]];
    for (; to[at] != 0xffffffffu; at++) is_closed &= to[at] != b;
    to[at] = b;
  }
  for (size_t i = 0; i < edges; i++) {
    const uint32_t b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
    int found = 0;
    for (size_t at = first[b]; at < first[b + 1]; at++) found |= to[at] == mesh->indices[i];
    is_closed &= found;
  }
  for (size_t i = 0; i < mesh->vertex_count; i++) is_closed &= first[i + 1] > first[i];
  free(first);
  free(to);
  return is_closed;
}

// Are the vertices points of the caller's, in their order?
static int hull_are_points(const nsvcd_mesh *mesh, const float *points, size_t count) {
  size_t at = 0;
  for (size_t i = 0; i < mesh->vertex_count; i++, at++) {
    while (at < count && memcmp(mesh->positions + 3 * i, points + 3 * at, 3 * sizeof(float))) at++;
    if (at >= count) return 0;
  }
  return 1;
}

// How far the farthest of points is outside of a hull, in sides of the points' box, at worst.
static double hull_farthest_outside(const nsvcd_mesh *mesh, const float *points, size_t count) {
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double worst = 0;
  for (size_t i = 0; i < 3 * count; i++) {
    low[i % 3] = fmin(low[i % 3], (double)points[i]);
    high[i % 3] = fmax(high[i % 3], (double)points[i]);
  }
  for (size_t i = 0; i < count; i++) {
    double nearest = HUGE_VAL, above = -HUGE_VAL;
    oracle_triangle p, t;
    // of a box of sides 1
    for (size_t k = 0; k < 9; k++)
      p.v[k / 3][k % 3] = ((double)points[3 * i + k % 3] - low[k % 3]) / (high[k % 3] - low[k % 3]);
    memset(p.normal, 0, sizeof p.normal);
    for (size_t n = 0; n < mesh->triangle_count; n++) {
      double u[3], v[3], on_p[3], on_t[3], height = 0, length;
      for (size_t k = 0; k < 9; k++)
        t.v[k / 3][k % 3] =
            ((double)mesh->positions[3 * mesh->indices[3 * n + k / 3] + k % 3] - low[k % 3]) /
            (high[k % 3] - low[k % 3]);
      oracle_sub(t.v[1], t.v[0], u);
      oracle_sub(t.v[2], t.v[0], v);
      oracle_cross(u, v, t.normal);
      length = sqrt(oracle_dot(t.normal, t.normal));
      oracle_sub(p.v[0], t.v[0], u);
      for (size_t k = 0; k < 3; k++) t.normal[k] /= length > 0 ? length : 1;
      height = oracle_dot(u, t.normal);
      above = fmax(above, height);
      if (height > -1e-7) nearest = fmin(nearest, oracle_triangles(&p, &t, nearest, on_p, on_t));
    }
    if (above > 0) worst = fmax(worst, sqrt(nearest));
  }
  return worst;
}

#define HULL_CLOUDS 10
static void hull_cloud(int kind, shapes_rng *rng, double size, double offset, float *points,
                       size_t count) {
  for (size_t i = 0; i < count; i++) {
    double p[3], length = 0;
    for (size_t k = 0; k < 3; k++) p[k] = shapes_uniform(rng, -1, 1);
    for (size_t k = 0; k < 3; k++) length += p[k] * p[k];
    for (size_t k = 0; k < 3 && kind == 0; k++) p[k] /= sqrt(length);        // sphere
    if (kind == 1) p[i % 3] = i / 3 % 2 ? 1 : -1;                            // faces of a cube
    for (size_t k = 0; k < 3 && kind == 2; k++) p[k] = floor(3 * p[k]) / 3;  // a grid
    for (size_t k = 0; k < 3 && kind == 3; k++)
      p[k] = (p[k] > 0) + 1e-7 * p[(k + 1) % 3];                          // clusters
    if (kind == 4) p[2] = p[0] + p[1] + 1e-6 * p[2];                      // a thin plate
    if (kind == 5) p[1] = p[0] + 1e-6 * p[1], p[2] = p[0] + 1e-6 * p[2];  // a needle
    if (kind == 6) p[0] = cos(3 * p[2]), p[1] = sin(3 * p[2]);            // a helix
    if (kind == 7) p[0] = cos(3 * p[0]), p[1] = sin(3 * acos(p[0])), p[2] = (int)(i % 2);  // rims
    if (kind == 8) p[2] *= 1e-9;  // flat but for roundings
    if (kind == 9 && i % 2) p[0] = p[1] = p[2] = i % 4 == 1 ? 0.3 : 0.3 + 3e-8;  // repeated
    for (size_t k = 0; k < 3; k++) points[3 * i + k] = (float)(offset + size * p[k]);
  }
}

static void hulls_hold_their_points(void) {
  static const double sizes[] = {1e-6, 1e-3, 1, 1e5};
  static float points[3 * 400];
  shapes_rng rng = {1};
  double worst = 0;
  for (size_t trial = 0; trial < check_many(160); trial++) {
    const double size = sizes[trial / HULL_CLOUDS % 4];
    const size_t count = trial % 3 == 0 ? 8 + trial % 30 : 400;
    nsvcd_mesh hull;
    hull_cloud((int)(trial % HULL_CLOUDS), &rng, size, trial / 40 % 2 ? 3 * size : 0, points,
               count);
    const nsvcd_result result = nsvcd_mesh_hull(points, count, NULL, &hull);
    // beside an offset a plate of 1e-9 is flat
    if (result == NSVCD_ERROR_EMPTY && trial % HULL_CLOUDS == 8) continue;
    CHECK_EQ(result, NSVCD_OK);
    if (result) continue;
    CHECK(hull_is_closed(&hull));
    CHECK(hull_are_points(&hull, points, count));
    const double outside = hull_farthest_outside(&hull, points, count);
    CHECK(outside < 2e-9 * sqrt(3));
    worst = fmax(worst, outside);
    nsvcd_mesh_free(&hull, NULL);
  }
  printf("hulls: a point is at most %.1e sides outside\n", worst);
}

// Twice the signed volume of a facet and a point, of whole numbers.
static int64_t hull_whole_height(const float *a, const float *b, const float *c, const float *p) {
  int64_t u[3], v[3], w[3];
  for (size_t k = 0; k < 3; k++) {
    u[k] = (int64_t)(b[k] - a[k]);
    v[k] = (int64_t)(c[k] - a[k]);
    w[k] = (int64_t)(p[k] - a[k]);
  }
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
         w[2] * (u[0] * v[1] - u[1] * v[0]);
}

// Do three planes of facets, of small whole numbers, meet at a vertex alone?
static int hull_is_corner(const nsvcd_mesh *hull, uint32_t vertex) {
  int64_t normals[3][3] = {{0}};
  int rank = 0;
  for (size_t n = 0; n < hull->triangle_count && rank < 3; n++) {
    const uint32_t *t = hull->indices + 3 * n;
    if (t[0] != vertex && t[1] != vertex && t[2] != vertex) continue;
    const float *a = hull->positions + 3 * t[0];
    for (size_t k = 0; k < 3; k++) {
      float axis[3] = {a[0], a[1], a[2]};
      axis[k]++;
      normals[rank][k] =
          hull_whole_height(a, hull->positions + 3 * t[1], hull->positions + 3 * t[2], axis);
    }
    int64_t c[3];
    for (size_t k = 0; k < 3; k++)
      c[k] = normals[0][(k + 1) % 3] * normals[1][(k + 2) % 3] -
             normals[0][(k + 2) % 3] * normals[1][(k + 1) % 3];
    if (rank == 0)
      rank = 1;
    else if (rank == 1)
      rank = c[0] || c[1] || c[2] ? 2 : 1;
    else
      rank = c[0] * normals[2][0] + c[1] * normals[2][1] + c[2] * normals[2][2] ? 3 : 2;
  }
  return rank == 3;
}

// Of whole numbers no point is outside at all, no facet is flat, and all vertices are corners.
static void hulls_of_whole_numbers_are_exact(void) {
  static float points[3 * 300];
  shapes_rng rng = {2};
  for (size_t trial = 0; trial < check_many(400); trial++) {
    const size_t count = 4 + (size_t)shapes_pick(&rng, 297);
    // few numbers, so that many are on a plane or a line; or up to 2^20
    const int most = trial % 3 == 0 ? 1 << 20 : 1 + shapes_pick(&rng, 6);
    nsvcd_mesh hull;
    for (size_t i = 0; i < 3 * count; i++)
      points[i] = (float)(shapes_pick(&rng, most + 1) - most / 2);
    const nsvcd_result result = nsvcd_mesh_hull(points, count, NULL, &hull);
    int64_t any = 0;
    for (size_t i = 3; i < count && !any && result; i++)
      for (size_t k = 1; k < i; k++)
        for (size_t l = 1; l < k; l++)
          any |= hull_whole_height(points, points + 3 * l, points + 3 * k, points + 3 * i);
    CHECK_EQ(result, any || !result ? NSVCD_OK : NSVCD_ERROR_EMPTY);
    if (result) continue;
    CHECK(hull_is_closed(&hull));
    int is_inside = 1, is_flat = 0;
    for (size_t n = 0; n < hull.triangle_count; n++) {
      const float *c[3];
      int64_t lowest = 0;
      for (size_t k = 0; k < 3; k++) c[k] = hull.positions + 3 * hull.indices[3 * n + k];
      for (size_t i = 0; i < count; i++) {
        const int64_t height = hull_whole_height(c[0], c[1], c[2], points + 3 * i);
        is_inside &= height <= 0;
        lowest = height < lowest ? height : lowest;
      }
      is_flat |= lowest == 0;
    }
    CHECK(is_inside);
    CHECK(!is_flat);
    for (uint32_t i = 0; i < hull.vertex_count && most < 10; i++) CHECK(hull_is_corner(&hull, i));
    nsvcd_mesh_free(&hull, NULL);
  }
}

// Of a grid only its corners are left; the hull is a solid, with its volume.
static void hull_of_a_grid_is_a_box(void) {
  static float points[3 * 1000];
  nsvcd_mesh hull;
  const nsvcd_body *body;
  for (size_t i = 0; i < 1000; i++) {
    points[3 * i] = (float)(i % 10);
    points[3 * i + 1] = (float)(i / 10 % 10) * 0.5f;
    points[3 * i + 2] = (float)(i / 100) * 0.25f;
  }
  CHECK_EQ(nsvcd_mesh_hull(points, 1000, NULL, &hull), NSVCD_OK);
  CHECK_EQ(hull.vertex_count, 8);
  CHECK_EQ(hull.triangle_count, 12);
  double volume = 0;
  for (size_t n = 0; n < 12; n++) {
    double c[3][3], cross[3];
    for (size_t k = 0; k < 9; k++)
      c[k / 3][k % 3] = (double)hull.positions[3 * hull.indices[3 * n + k / 3] + k % 3];
    oracle_cross(c[0], c[1], cross);
    volume += oracle_dot(cross, c[2]) / 6;
  }
  CHECK_NEAR(volume, 9 * 4.5 * 2.25, 1e-9);
  CHECK_EQ(nsvcd_encode(&hull, NULL, NULL, NULL, 0, &body), NSVCD_OK);
  CHECK_EQ(nsvcd_body_describe(body).open_components, 0);
  nsvcd_body_free(body, NULL);
  nsvcd_mesh_free(&hull, NULL);
}

// 100,000 points, whatever their hull, in a time that grows as n log n: seconds if it were n^2.
static void large_hulls_take_little_time(void) {
  const size_t count = 100000;
  float *points = (float *)malloc(3 * count * sizeof *points);
  shapes_rng rng = {3};
  for (int kind = 0; kind < 8; kind++) {
    nsvcd_mesh hull;
    hull_cloud(kind, &rng, 1, 0, points, count);
    const clock_t begin = clock();
    CHECK_EQ(nsvcd_mesh_hull(points, count, NULL, &hull), NSVCD_OK);
    const double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    CHECK(seconds < 20);
    CHECK(hull_is_closed(&hull));
    printf("hull of %zu points, kind %d: %.3f s, %zu vertices\n", count, kind, seconds,
           hull.vertex_count);
    nsvcd_mesh_free(&hull, NULL);
  }
  free(points);
}

// ---- an allocator that has no more after so many

typedef struct little_memory {
  size_t left, given;
} little_memory;
static void *little_take(size_t size, void *user) {
  little_memory *memory = (little_memory *)user;
  if (memory->left == 0) return NULL;
  memory->left--;
  memory->given++;
  return malloc(size);
}
static void little_give(void *at, void *user) {
  ((little_memory *)user)->given--;
  free(at);
}

static void hulls_refuse(void) {
  static float points[3 * 2000];
  shapes_rng rng = {4};
  nsvcd_mesh hull = {NULL, NULL, 7, 9};
  hull_cloud(0, &rng, 1, 0, points, 2000);
  CHECK_EQ(nsvcd_mesh_hull(NULL, 2000, NULL, &hull), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_hull(points, 2000, NULL, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_hull(points, (size_t)1 << 31, NULL, &hull), NSVCD_ERROR_TOO_LARGE);
  for (size_t count = 0; count < 4; count++)
    CHECK_EQ(nsvcd_mesh_hull(points, count, NULL, &hull), NSVCD_ERROR_EMPTY);
  little_memory memory = {0, 0};
  const nsvcd_allocator allocator = {little_take, little_give, &memory};
  size_t failures = 0;
  for (;; failures++) {
    memory.left = failures;
    const nsvcd_result result = nsvcd_mesh_hull(points, 2000, &allocator, &hull);
    if (!result) break;
    CHECK_EQ(result, NSVCD_ERROR_MEMORY);
    CHECK_EQ(memory.given, 0);
    CHECK_EQ(hull.vertex_count, 7);
  }
  CHECK(failures > 8);
  CHECK_EQ(memory.given, 2);
  nsvcd_mesh_free(&hull, &allocator);
  hull.vertex_count = 7;
  for (int kind = 0; kind < 4; kind++) {
    // in a plane, on a line, at one point, in an oblique plane
    for (size_t i = 0; i < 300; i++) {
      const float x = (float)shapes_pick(&rng, 1000), y = (float)shapes_pick(&rng, 1000);
      points[3 * i] = kind < 2 || kind == 3 ? x : 3;
      points[3 * i + 1] = kind == 0 || kind == 3 ? y : kind == 1 ? 2 * x : 3;
      points[3 * i + 2] = kind == 1 || kind == 3 ? x + points[3 * i + 1] : 3;
    }
    CHECK_EQ(nsvcd_mesh_hull(points, 300, NULL, &hull), NSVCD_ERROR_EMPTY);
  }
  points[4] = 2e6f;
  CHECK_EQ(nsvcd_mesh_hull(points, 300, NULL, &hull), NSVCD_ERROR_NUMBER);
  points[4] = NAN;
  CHECK_EQ(nsvcd_mesh_hull(points, 300, NULL, &hull), NSVCD_ERROR_NUMBER);
  CHECK_EQ(hull.vertex_count, 7);
}

// ---- height fields

// The height of a field by its definition, from the samples alone; NaN over a hole.
static double field_height(const float *heights, size_t columns, const float *step, double x,
                           double y) {
  const double u = x / (double)step[0], v = y / (double)step[1];
  const size_t c = (size_t)u, r = (size_t)v;
  const double s = u - (double)c, t = v - (double)r;
  const float *at = heights + r * columns + c;
  const double a = (double)at[0], b = (double)at[1], d = (double)at[columns],
               e = (double)at[columns + 1];
  if (isnan(b)) return s <= t ? a + s * (e - d) + t * (d - a) : NAN;
  if (isnan(d)) return s >= t ? a + s * (b - a) + t * (e - b) : NAN;
  if (isnan(a)) return s + t >= 1 ? e + (1 - s) * (d - e) + (1 - t) * (b - e) : NAN;
  if (isnan(e)) return s + t <= 1 ? a + s * (b - a) + t * (d - a) : NAN;
  return s >= t ? a + s * (b - a) + t * (e - b) : a + s * (e - d) + t * (d - a);
}

// A tiny ball falls, and meets the surface where the samples say, or falls through a hole.
static void heights_are_where_they_are(void) {
  const size_t rows = 9, columns = 14;
  const float step[2] = {0.5f, 0.25f};
  const float radius = 1e-4f;
  float heights[9 * 14];
  shapes_rng rng = {5};
  for (size_t i = 0; i < rows * columns; i++)
    heights[i] = i % 11 == 5 ? NAN : (float)shapes_uniform(&rng, -0.2, 0.2);
  nsvcd_mesh mesh;
  const nsvcd_body *field, *ball;
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.open = 1;
  CHECK_EQ(nsvcd_mesh_of_heights(heights, rows, columns, step, NULL, &mesh), NSVCD_OK);
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &field), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_sphere(radius, NULL, &ball), NSVCD_OK);
  for (size_t n = 0; n < mesh.triangle_count; n++) {
    const float *c[3];
    for (size_t k = 0; k < 3; k++) c[k] = mesh.positions + 3 * mesh.indices[3 * n + k];
    CHECK((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) > (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]));
  }
  size_t holes = 0;
  for (size_t trial = 0; trial < check_many(600); trial++) {
    const float x = (float)shapes_uniform(&rng, 0, 6.5), y = (float)shapes_uniform(&rng, 0, 2);
    const nsvcd_pose path[2] = {{{x, y, 1}, {0, 0, 0, 1}}, {{x, y, -1}, {0, 0, 0, 1}}};
    nsvcd_question question;
    nsvcd_answer answer;
    static uint64_t memory[1 << 17];
    memset(&question, 0, sizeof question);
    question.a.body = ball;
    question.a.poses = path;
    question.a.count = 2;
    question.b.body = field;
    question.ask = NSVCD_ASK_FIRST;
    question.to = 1e-6f;
    CHECK(nsvcd_sweep_workspace_size(&question) <= sizeof memory);
    CHECK_EQ(nsvcd_sweep(&question, memory, sizeof memory, &answer), NSVCD_OK);
    const double height = field_height(heights, columns, step, (double)x, (double)y);
    double rim = 0;
    for (int k = 0; k < 4; k++)
      rim += field_height(heights, columns, step,
                          fmin(fmax((double)x + (k % 2 ? 3e-4 : -3e-4), 0), 6.4999),
                          fmin(fmax((double)y + (k / 2 ? 3e-4 : -3e-4), 0), 1.9999));
    // the ball is wider than a point, so not at the rim of a hole
    if (isnan(height) != isnan(rim)) continue;
    holes += isnan(height);
    CHECK_EQ(answer.verdict, isnan(height) ? NSVCD_FREE : NSVCD_HIT);
    if (!isnan(height)) CHECK_NEAR(1 - 2 * (double)answer.time.high, height, 1e-3);
  }
  CHECK(holes > 50);
  nsvcd_body_free(field, NULL);
  nsvcd_body_free(ball, NULL);
  nsvcd_mesh_free(&mesh, NULL);
}

// A cell of four samples is cut from its first one, a cell of three is one triangle.
static void heights_are_cut_as_they_say(void) {
  const float step[2] = {2, 3};
  for (int lacks = -1; lacks < 5; lacks++) {
    float heights[4] = {1, 2, 3, 4};
    nsvcd_mesh mesh = {NULL, NULL, 7, 9};
    if (lacks >= 0) heights[lacks % 4] = NAN;
    if (lacks == 4) heights[3] = NAN;
    const nsvcd_result result = nsvcd_mesh_of_heights(heights, 2, 2, step, NULL, &mesh);
    CHECK_EQ(result, lacks == 4 ? NSVCD_ERROR_EMPTY : NSVCD_OK);
    CHECK_EQ(mesh.vertex_count, lacks == 4 ? 7 : lacks < 0 ? 4 : 3);
    CHECK_EQ(mesh.triangle_count, lacks == 4 ? 9 : lacks < 0 ? 2 : 1);
    if (result) continue;
    for (size_t i = 0; i < mesh.vertex_count; i++) {
      const int sample = (int)mesh.positions[3 * i + 2] - 1;
      CHECK(mesh.positions[3 * i] == (float)(sample % 2) * 2 &&
            mesh.positions[3 * i + 1] == (float)(sample / 2) * 3);
    }
    static const uint32_t whole[6] = {0, 1, 3, 0, 3, 2};
    if (lacks < 0) CHECK(!memcmp(mesh.indices, whole, sizeof whole));
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static void heights_refuse(void) {
  float heights[6] = {0, 0, 0, 0, 0, 0};
  const float step[2] = {1, 1};
  const float bad[][2] = {{0, 1}, {1, -1}, {NAN, 1}, {1, INFINITY}};
  nsvcd_mesh mesh = {NULL, NULL, 7, 9};
  CHECK_EQ(nsvcd_mesh_of_heights(NULL, 2, 3, step, NULL, &mesh), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, NULL, NULL, &mesh), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, step, NULL, NULL), NSVCD_ERROR_ARGUMENT);
  for (size_t i = 0; i < 4; i++)
    CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, bad[i], NULL, &mesh), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 1, 6, step, NULL, &mesh), NSVCD_ERROR_EMPTY);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 6, 1, step, NULL, &mesh), NSVCD_ERROR_EMPTY);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 0, 0, step, NULL, &mesh), NSVCD_ERROR_EMPTY);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, SIZE_MAX / 2, 4, step, NULL, &mesh),
           NSVCD_ERROR_TOO_LARGE);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 1 << 15, 1 << 15, step, NULL, &mesh),
           NSVCD_ERROR_TOO_LARGE);
  const float far[2] = {6e5f, 1};
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, far, NULL, &mesh), NSVCD_ERROR_NUMBER);
  heights[2] = INFINITY;
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, step, NULL, &mesh), NSVCD_ERROR_NUMBER);
  heights[2] = -2e6f;
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, step, NULL, &mesh), NSVCD_ERROR_NUMBER);
  heights[2] = 0;
  little_memory memory = {0, 0};
  const nsvcd_allocator allocator = {little_take, little_give, &memory};
  for (size_t n = 0; n < 2; n++) {
    memory.left = n;
    CHECK_EQ(nsvcd_mesh_of_heights(heights, 2, 3, step, &allocator, &mesh), NSVCD_ERROR_MEMORY);
    CHECK_EQ(memory.given, 0);
  }
  CHECK_EQ(mesh.vertex_count, 7);
}

// ---- bodies that are scaled, by a factor for each axis

#define STRETCH_KINDS 7
static nsvcd_mesh stretch_mesh(int kind, shapes_rng *rng) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  if (kind == 0) shapes_random_solid(&shape, rng, 0.4);
  if (kind == 1) shapes_torus(&shape, 0.2, 0.05, 96, 40);
  if (kind == 2) shapes_mug(&shape, 0.1, 0.2, 0.01, 32);
  if (kind == 3) shapes_random_hollow(&shape, rng, 0, 0.4);
  if (kind == 4) shapes_box(&shape, 0.3, 0.2, 0.1, 1);
  if (kind == 5) shapes_box(&shape, 1, 1, 0.02, 1), shapes_ellipsoid(&shape, 0.1, 0.1, 0.1, 24);
  if (kind == 6) shapes_ellipsoid(&shape, 0.3, 0.3, 0.3, 90);  // a level, by its options
  const nsvcd_mesh mesh = mesh_of(&shape);
  shapes_free(&shape);
  return mesh;
}

// The mesh, each coordinate times its factor, and turned if it is mirrored.
static void stretch_positions(nsvcd_mesh *mesh, const float *scale) {
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++) mesh->positions[i] *= scale[i % 3];
  for (size_t n = 0; n < mesh->triangle_count && scale[0] * scale[1] * scale[2] < 0; n++) {
    const uint32_t corner = mesh->indices[3 * n + 1];
    mesh->indices[3 * n + 1] = mesh->indices[3 * n + 2];
    mesh->indices[3 * n + 2] = corner;
  }
}

// Is a point within all that bounds a patch?
static int stretch_is_within(const nsvcd__geometry *f, size_t i, nsvcd__d3 point) {
  const nsvcd__sphere sphere = nsvcd__sphere_of(nsvcd__body_patches(f->body), i);
  const nsvcd__slab slab = nsvcd__slab_at(f->slabs, f->body->padded, i);
  const nsvcd__d3 n = nsvcd__d3_widen(slab.normal);
  const nsvcd__d3 from = nsvcd__d3_sub(point, nsvcd__d3_widen(sphere.centre));
  const double height = nsvcd__d3_dot(n, from), square = nsvcd__d3_dot(from, from);
  int ok = f->hull_counts[i] > 0 && sqrt(square) <= (double)sphere.radius &&
           height >= (double)slab.low && height <= (double)slab.high &&
           square - height * height <= (double)slab.across * (double)slab.across;
  for (size_t d = 0; d < 26 && ok; d++) {
    const size_t code = d < 13 ? d : d + 1;
    const nsvcd__d3 along =
        nsvcd__d3_of((double)(code % 3) - 1, (double)(code / 3 % 3) - 1, (double)(code / 9) - 1);
    double most = -HUGE_VAL;
    for (size_t v = 0; v < f->hull_counts[i]; v++)
      most = fmax(most, nsvcd__d3_dot(along, nsvcd__stored_point(f, i, v)));
    ok = nsvcd__d3_dot(along, point) <= most + nsvcd__d3_norm(along) * (double)f->margins[i];
  }
  return ok;
}

// Is each point of the stretched surface within the bounds of a patch that it was in before? Are
// stored points where they were, stretched, to the error that is stated?
static int stretch_is_outward(const nsvcd_body *body, const nsvcd_body *scaled, const float *scale,
                              const nsvcd_mesh *stretched, const float *positions,
                              shapes_rng *rng) {
  const nsvcd__geometry a = nsvcd__geometry_of(nsvcd__triangles_of(body));
  const nsvcd__geometry b = nsvcd__geometry_of(nsvcd__triangles_of(scaled));
  int ok = 1;
  for (size_t i = 0; i < b.body->patches; i++) {
    for (size_t k = 0; k < nsvcd__points_of(&b, i).stored; k++) {
      const nsvcd__d3 was = nsvcd__stored_point(&a, i, k);
      const nsvcd__d3 there = nsvcd__d3_of(was.x * (double)scale[0], was.y * (double)scale[1],
                                           was.z * (double)scale[2]);
      ok &= sqrt(nsvcd__d3_distance2(nsvcd__stored_point(&b, i, k), there)) <= (double)b.margins[i];
    }
  }
  for (size_t n = 0; n < 1000; n++) {
    const uint32_t *t =
        stretched->indices + 3 * (size_t)shapes_pick(rng, (int)stretched->triangle_count);
    const double u = shapes_uniform(rng, 0, 1), v = shapes_uniform(rng, 0, 1 - u);
    nsvcd__d3 at[2];
    for (size_t k = 0; k < 2; k++) {
      const float *rows = k ? stretched->positions : positions;
      const nsvcd__d3 c = nsvcd__d3_row(rows, t[0]);
      at[k] = nsvcd__d3_fma(u, nsvcd__d3_sub(nsvcd__d3_row(rows, t[1]), c),
                            nsvcd__d3_fma(v, nsvcd__d3_sub(nsvcd__d3_row(rows, t[2]), c), c));
    }
    int held = 0;
    for (size_t i = 0; i < b.body->patches && !held; i++)
      held = stretch_is_within(&a, i, at[0]) && stretch_is_within(&b, i, at[1]);
    ok &= held;
  }
  return ok;
}

// Are the triangles those of the stretched mesh, wound as they are?
static int stretch_is_wound(const nsvcd_body *scaled, const nsvcd_mesh *mesh) {
  const nsvcd__geometry f = nsvcd__geometry_of(nsvcd__triangles_of(scaled));
  int ok = 1;
  for (size_t i = 0; i < f.body->patches; i++)
    for (size_t n = f.first_triangle[i]; n < f.first_triangle[i + 1]; n++) {
      const uint32_t *t = mesh->indices + 3 * (size_t)nsvcd__triangle_number(&f, i, n);
      nsvcd__d3 c[2][3], normals[2];
      nsvcd__patch_triangle(&f, i, n, c[0]);
      for (size_t k = 0; k < 3; k++) c[1][k] = nsvcd__d3_row(mesh->positions, t[k]);
      for (size_t k = 0; k < 2; k++)
        normals[k] =
            nsvcd__d3_cross(nsvcd__d3_sub(c[k][1], c[k][0]), nsvcd__d3_sub(c[k][2], c[k][0]));
      ok &= nsvcd__d3_distance2(normals[0], normals[1]) <=
            1e-12 * nsvcd__d3_dot(normals[1], normals[1]);
    }
  return ok;
}

static void stretch_factors(shapes_rng *rng, size_t trial, float *scale) {
  for (size_t k = 0; k < 3; k++) {
    scale[k] = (float)exp(shapes_uniform(rng, -1.5, 1.5));
    if (trial % 4 == 1) scale[k] = (float)ldexp(1, shapes_pick(rng, 5) - 2);  // exact
    if (trial % 3 == 1 && shapes_pick(rng, 2)) scale[k] = -scale[k];
  }
  if (trial % 10 == 9) scale[shapes_pick(rng, 3)] *= 0.02f;
}

static nsvcd_answer stretch_ask(const nsvcd_body *moving, const nsvcd_body *other, nsvcd_ask ask,
                                const nsvcd_pose *path) {
  static uint64_t memory[1 << 20];
  nsvcd_question question;
  nsvcd_answer answer;
  memset(&question, 0, sizeof question);
  question.a.body = moving;
  question.a.poses = path;
  question.a.count = 2;
  question.b.body = other;
  question.ask = ask;
  if (ask != NSVCD_ASK_HIT) question.to = 1e-5f;
  CHECK(nsvcd_sweep_workspace_size(&question) <= sizeof memory);
  CHECK_EQ(nsvcd_sweep(&question, memory, sizeof memory, &answer), NSVCD_OK);
  return answer;
}

// The same verdicts, times, distances and normals as the stretched mesh, encoded.
static void stretched_bodies_are_those_of_stretched_meshes(void) {
  shapes_rng rng = {6};
  size_t hits = 0, differ = 0, asked = 0;
  const nsvcd_body *other;
  nsvcd_mesh probe = stretch_mesh(0, &rng);
  CHECK_EQ(nsvcd_encode(&probe, NULL, NULL, NULL, 0, &other), NSVCD_OK);
  nsvcd_mesh_free(&probe, NULL);
  for (size_t trial = 0; trial < check_many(3 * STRETCH_KINDS); trial++) {
    const int kind = (int)(trial % STRETCH_KINDS);
    nsvcd_mesh mesh = stretch_mesh(kind, &rng);
    nsvcd_encode_options options;
    float scale[3];
    const nsvcd_body *body, *wanted, *scaled;
    memset(&options, 0, sizeof options);
    options.patches = kind == 6 ? 700 : 0;
    options.coarse = trial == 16;
    options.balls = kind == 2 ? 32 : 0;
    stretch_factors(&rng, trial, scale);
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_OK);
    float *positions = (float *)malloc(3 * mesh.vertex_count * sizeof *positions);
    memcpy(positions, mesh.positions, 3 * mesh.vertex_count * sizeof *positions);
    stretch_positions(&mesh, scale);
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &wanted), NSVCD_OK);
    const nsvcd_body_facts facts = nsvcd_body_describe(body), want = nsvcd_body_describe(wanted);
    void *memory = malloc(facts.size);
    CHECK_EQ(nsvcd_body_scale(body, scale, memory, facts.size, &scaled), NSVCD_OK);
    CHECK_EQ(nsvcd_body_load(memory, facts.size, &scaled), NSVCD_OK);
    const nsvcd_body_facts is = nsvcd_body_describe(scaled);
    if (!options.coarse) CHECK(stretch_is_wound(scaled, &mesh));
    CHECK(stretch_is_outward(body, scaled, scale, &mesh, positions, &rng));
    CHECK(is.radius <= 1.2f * want.radius && is.mean_patch_radius <= 3 * want.mean_patch_radius);
    CHECK_EQ(is.open_components, want.open_components);
    if (trial % 4 == 1 && trial % 10 != 9 && !options.coarse) CHECK(!(is.quantization_error > 0));
    if (!options.coarse) CHECK(is.quantization_error <= 4e-7f * is.extent);
    for (size_t k = 0; k < 3; k++) {
      CHECK_NEAR(is.low[k], want.low[k], (options.coarse ? 1e-3 : 1e-4) * want.radius);
      CHECK_NEAR(is.high[k], want.high[k], (options.coarse ? 1e-3 : 1e-4) * want.radius);
    }
    for (size_t n = 0; n < 100; n++) {
      nsvcd_pose path[2];
      for (size_t p = 0; p < 2; p++) {
        double direction[3], turn[4];
        shapes_direction(&rng, direction);
        shapes_quaternion(&rng, turn);
        for (size_t k = 0; k < 4; k++) path[p].rotation[k] = (float)turn[k];
        for (size_t k = 0; k < 3; k++)
          path[p].position[k] =
              (float)(direction[k] * ((double)want.radius + shapes_uniform(&rng, 0, 0.5)));
      }
      const nsvcd_ask ask = n % 3 == 0   ? NSVCD_ASK_HIT
                            : n % 3 == 1 ? NSVCD_ASK_FIRST
                                         : NSVCD_ASK_DISTANCE;
      const nsvcd_answer x = stretch_ask(scaled, other, ask, path),
                         y = stretch_ask(wanted, other, ask, path);
      asked++;
      hits += y.verdict == NSVCD_HIT;
      differ += x.verdict != y.verdict && !options.coarse;
      CHECK(x.verdict == y.verdict || x.verdict == NSVCD_UNDECIDED || options.coarse);
      if (x.verdict != y.verdict || options.coarse) continue;
      if (ask == NSVCD_ASK_FIRST && x.verdict == NSVCD_HIT) {
        CHECK(x.time.low <= y.time.high + 1e-6f && y.time.low <= x.time.high + 1e-6f);
      }
      if (ask == NSVCD_ASK_DISTANCE)
        CHECK(x.distance.low <= y.distance.high + 1e-6f &&
              y.distance.low <= x.distance.high + 1e-6f);
    }
    free(memory);
    free(positions);
    nsvcd_body_free(body, NULL);
    nsvcd_body_free(wanted, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
  printf("stretched: %zu of %zu hit, %zu undecided\n", hits, asked, differ);
  CHECK(hits > asked / 10 && hits < asked - asked / 10);
  CHECK(differ <= asked / 200);
  nsvcd_body_free(other, NULL);
}

static void stretched_bodies_refuse(void) {
  static uint64_t memory[1 << 14];
  static const float bad[][3] = {
      {0, 1, 1}, {1, NAN, 1}, {1, 1, INFINITY}, {1e30f, 1, 1}, {1, 1, 1e-20f}};
  const nsvcd_body *ball, *box, *scaled = NULL;
  const float half[3] = {1, 1, 1}, long_one[3] = {1, 1, 2}, mirror[3] = {-2, 2, 2};
  CHECK_EQ(nsvcd_encode_sphere(1, NULL, &ball), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &box), NSVCD_OK);
  CHECK_EQ(nsvcd_body_scale(ball, long_one, memory, sizeof memory, &scaled), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(ball, NULL, memory, sizeof memory, &scaled), NSVCD_ERROR_ARGUMENT);
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
    CHECK_EQ(nsvcd_body_scale(box, bad[k], memory, sizeof memory, &scaled), NSVCD_ERROR_SCALE);
  CHECK(!scaled);
  CHECK_EQ(nsvcd_body_scale(ball, mirror, memory, sizeof memory, &scaled), NSVCD_OK);
  CHECK_NEAR(nsvcd_body_describe(scaled).radius, 2, 1e-5);
  nsvcd_body_free(ball, NULL);
  nsvcd_body_free(box, NULL);
}

void test_shapes(void) {
  RUN(hulls_hold_their_points);
  RUN(hulls_of_whole_numbers_are_exact);
  RUN(hull_of_a_grid_is_a_box);
  RUN(large_hulls_take_little_time);
  RUN(hulls_refuse);
  RUN(heights_are_where_they_are);
  RUN(heights_are_cut_as_they_say);
  RUN(heights_refuse);
  RUN(stretched_bodies_are_those_of_stretched_meshes);
  RUN(stretched_bodies_refuse);
}

CHECK_ALONE(test_shapes)
