// Surface points, farthest point sampling, and patches with the balls that cover them.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/mesh/mesh.h"
#include "../src/patches/covering.h"

#include "arrays.h"
#include "check.h"
#include "mesh_kinds.h"

void test_patches(void);

// ---------------------------------------------------------------------------------- surface points

static void mesh_samples_are_uniform(void) {
  enum { S = 8192 };
  static float points[3 * S], normals[3 * S];
  nsvcd_mesh mesh = mesh_box(0.1, 0.2, 0.3);
  // One triangle more, without area, first of all: never chosen.
  mesh.indices = (uint32_t *)realloc(mesh.indices, 39 * sizeof(uint32_t));
  memmove(mesh.indices + 3, mesh.indices, 36 * sizeof(uint32_t));
  mesh.indices[0] = mesh.indices[1] = 0;
  mesh.indices[2] = 7;
  mesh.triangle_count = 13;
  nsvcd__sample_surface(&mesh, S, mesh_f3s(points), mesh_f3s(normals));
  double face[6] = {0, 0, 0, 0, 0, 0};
  double mean[6][2] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
  static const double half[3] = {0.1, 0.2, 0.3};
  for (size_t s = 0; s < S; ++s) {
    const float *p = points + 3 * s;
    const float *n = normals + 3 * s;
    CHECK_NEAR(length3(n), 1, 1e-6);
    size_t axis = fabsf(n[0]) > 0.9f ? 0 : fabsf(n[1]) > 0.9f ? 1 : 2;
    size_t side = n[axis] > 0;
    CHECK_NEAR(p[axis], side ? half[axis] : -half[axis], 1e-7);
    face[2 * axis + side]++;
    for (size_t k = 0; k < 2; ++k)
      mean[2 * axis + side][k] += (double)p[(axis + 1 + k) % 3] / half[(axis + 1 + k) % 3];
  }
  double total = 0.02 + 0.06 + 0.03;  // of the three products of half extents
  for (size_t f = 0; f < 6; ++f) {
    double fraction = (f < 2 ? 0.06 : f < 4 ? 0.03 : 0.02) / (2 * total);
    CHECK_NEAR(face[f], (double)S * fraction, 1.01);  // stratified: to one sample at each end
    for (size_t k = 0; k < 2; ++k) CHECK_NEAR(mean[f][k] / face[f], 0, 0.02);
  }
  nsvcd_mesh_free(&mesh, NULL);

  mesh = mesh_round(30, 40, 0.1, 0.04);  // every triangle gets its share, to one sample
  nsvcd__sample_surface(&mesh, S, mesh_f3s(points), mesh_f3s(normals));
  double z2 = 0;
  double exact = 0;
  for (size_t s = 0; s < S; ++s)
    z2 += (double)points[3 * s + 2] * (double)points[3 * s + 2] / (double)S;
  // integral of z^2 over a triangle: mean over the edges' middles
  for (size_t t = 0; t < mesh.triangle_count; ++t) {
    double c[3][3], v[3];
    double area = mesh_triangle(&mesh, t, c, v) / nsvcd__mesh_area(&mesh);
    for (int i = 0; i < 3; ++i) exact += area / 3 * pow(0.5 * (c[i][2] + c[(i + 1) % 3][2]), 2);
  }
  CHECK_NEAR(z2 / exact, 1, 2e-3);
  nsvcd_mesh_free(&mesh, NULL);
}

static void mesh_samples_scale(void) {
  enum { S = 1000 };
  static float a[3 * S], b[3 * S], normals[3 * S], scaled_normals[3 * S];
  static const float scales[] = {0.0009765625f, 1048576.0f, 1e-3f, 1e3f, 1e-9f, 3e-15f};
  for (size_t i = 0; i < sizeof scales / sizeof scales[0]; ++i) {
    nsvcd_mesh mesh = mesh_round(25, 31, 0.1, 0.04);
    nsvcd__sample_surface(&mesh, S, mesh_f3s(a), mesh_f3s(normals));
    mesh_scale(&mesh, scales[i]);
    nsvcd__sample_surface(&mesh, S, mesh_f3s(b), mesh_f3s(scaled_normals));
    double worst = 0;
    double turned = 0;
    for (size_t k = 0; k < 3 * S; ++k) {
      worst = fmax(worst, fabs((double)b[k] / (double)scales[i] - (double)a[k]));
      turned = fmax(turned, fabs((double)normals[k] - (double)scaled_normals[k]));
    }
    CHECK_LE(worst, i < 2 ? 0 : 1e-7);  // a power of two changes nothing at all
    CHECK_LE(turned, i < 2 ? 0 : 1e-5);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static void mesh_samples_lie_mid_stratum(void) {
  float points[12], normals[12];
  nsvcd_mesh mesh = mesh_fan(2, 1, 1);  // triangles of equal area,
  mesh.positions[4] = 0.2f;             // now a fifth and four fifths of the whole
  nsvcd__sample_surface(&mesh, 4, mesh_f3s(points), mesh_f3s(normals));
  // at 1/8, 3/8, 5/8, 7/8
  for (int i = 0; i < 4; ++i) CHECK_EQ(points[3 * i + 1] < 0.2f * points[3 * i], i == 0);
  nsvcd_mesh_free(&mesh, NULL);
}

// ----------------------------------------------------------------------------------------- patches

// Samples without a mesh: (n, 3) random points, some of them equal.
static nsvcd__patches patches_of_points(size_t centres, size_t samples, nsvcd__arena *arena) {
  nsvcd__patches p;
  CHECK(nsvcd__patches_alloc(&p, centres, samples, 0, arena));
  for (size_t s = 0; s < samples; ++s) {
    p.drawn[s].x = (float)mesh_below(40);
    p.drawn[s].y = (float)mesh_below(40);
    p.drawn[s].z = (float)mesh_below(4);
  }
  return p;
}

// Each centre is, at its turn, a sample farthest from those before it; each sample goes to a
// nearest centre.
static void mesh_farthest_points_are_farthest(void) {
  mesh_rng = 51;
  for (int round = 0; round < 20; ++round) {
    nsvcd__arena arena = nsvcd__arena_of(NULL);
    nsvcd__patches p = patches_of_points(60, 1500, &arena);
    nsvcd__farthest_points(&p);
    CHECK_EQ(p.count, 60);
    for (uint32_t i = 1; i <= p.count; ++i) {
      float farthest = 0;
      float centre = HUGE_VALF;
      for (uint32_t j = 0; i < p.count && j < i; ++j) {
        centre = fminf(centre, nsvcd__to_centre2(&p, j, p.centres[i]));
      }
      for (size_t s = 0; s < p.sample_count; ++s) {
        float nearest = HUGE_VALF;
        for (uint32_t j = 0; j < i; ++j)
          nearest = fminf(nearest, nsvcd__to_centre2(&p, j, p.drawn[s]));
        farthest = fmaxf(farthest, nearest);
        if (i == p.count) CHECK_EQ(nearest, nsvcd__to_centre2(&p, p.owners[s], p.drawn[s]));
      }
      if (i < p.count) CHECK_EQ(centre, farthest);
    }
    nsvcd__arena_free(&arena);
  }
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  nsvcd__patches p = patches_of_points(10, 64, &arena);
  for (size_t s = 0; s < 64; ++s) {  // three places for ten centres
    p.drawn[s] = nsvcd__f3_of((float)(s % 3), 5, 5);
  }
  nsvcd__farthest_points(&p);
  CHECK_EQ(p.count, 3);
  nsvcd__arena_free(&arena);
}

static void mesh_centres_without_samples_are_dropped(void) {
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  nsvcd__patches p = patches_of_points(4, 64, &arena);
  for (size_t s = 0; s < 64; ++s) {
    p.drawn[s].x = (float)s;
    p.owners[s] = s < 32 ? 3 : 1;
  }
  nsvcd__move_centres(&p);
  CHECK_EQ(p.count, 2);
  CHECK_EQ(p.centres[0].x, 47.5);
  CHECK_EQ(p.centres[1].x, 15.5);
  for (size_t s = 0; s < 64; ++s) CHECK_EQ(p.owners[s], s < 32);
  // Of two centres at the same distance the first one is nearest, whatever the guess.
  const nsvcd__f3 origin = {0, 0, 0};
  p.centres[0] = nsvcd__f3_of(1, 0, 0);
  p.centres[1] = nsvcd__f3_of(-1, 0, 0);
  nsvcd__link_centres(&p, 0);
  CHECK_EQ(nsvcd__nearest_centre(&p, 0, origin), 0);
  CHECK_EQ(nsvcd__nearest_centre(&p, 1, origin), 0);
  nsvcd__arena_free(&arena);
}

// r^2 N / area: 1/pi for discs that do not overlap, 0.385 for hexagons; all that exceeds it is
// wasted broad phase.
static void mesh_patches_are_round(void) {
  static const size_t counts[] = {64, 128, 256, 512};
  for (int n = 0; n < 4; ++n) {
    nsvcd_mesh mesh = mesh_kind(2);
    nsvcd__arena arena = nsvcd__arena_of(NULL);
    nsvcd__patches p;
    double samples = 0;
    double balls = 0;
    CHECK_EQ(nsvcd__patches_build(&mesh, counts[n], 1, &arena, &p), NSVCD_OK);
    for (size_t i = 0; i < p.count; ++i) {
      samples += (double)p.sample_radii[i] / (double)p.count;
      balls += (double)p.radii[i] / (double)p.count;
    }
    double area = nsvcd__mesh_area(&mesh) / (double)p.count;
    printf("N %d: r^2 N / area: samples %.3f, balls %.3f\n", (int)p.count, samples * samples / area,
           balls * balls / area);
    CHECK_LE(samples * samples / area, 0.38);
    CHECK_LE(balls * balls / area, 0.53);
    nsvcd__arena_free(&arena);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static int patches_cover(const nsvcd__patches *p, const double *x) {
  for (size_t i = 0; i < p->count; ++i) {
    double d = nsvcd__d3_distance2(nsvcd__d3_of(x[0], x[1], x[2]), nsvcd__d3_widen(p->centres[i]));
    if (d <= (double)p->radii[i] * (double)p->radii[i]) return 1;
  }
  return 0;
}

static void mesh_patches_cover_the_surface(void) {
  static const size_t counts[] = {1, 2, 17, 128, 512};
  long tried = 0;
  long lost = 0;
  mesh_rng = 21;
  for (int kind = 0; kind < MESH_KINDS; ++kind) {
    for (int n = 0; n < 5; ++n) {
      nsvcd_mesh mesh = mesh_kind(kind);
      nsvcd__arena arena = nsvcd__arena_of(NULL);
      nsvcd__patches p;
      CHECK_EQ(nsvcd__patches_build(&mesh, counts[n], 1, &arena, &p), NSVCD_OK);
      CHECK(p.count >= 1 && p.count <= counts[n]);
      for (size_t s = 0; s < 6000; ++s) {  // corners, edges and insides of triangles
        double c[3][3];
        double x[3];
        double u = mesh_uniform(0, 1);
        double v = mesh_uniform(0, 1 - u);
        double vector[3];
        size_t t = s < mesh.triangle_count ? s : mesh_below(mesh.triangle_count);
        mesh_triangle(&mesh, t, c, vector);
        if (s % 4 == 1) u = 0;
        if (s % 4 == 2) {
          u = 0;
          v = 0;
        }
        for (int k = 0; k < 3; ++k)
          x[k] = c[0][k] + u * (c[1][k] - c[0][k]) + v * (c[2][k] - c[0][k]);
        lost += !patches_cover(&p, x);
        tried++;
      }
      nsvcd__arena_free(&arena);
      nsvcd_mesh_free(&mesh, NULL);
    }
  }
  printf("%ld surface points, %ld outside all balls\n", tried, lost);
  CHECK_EQ(lost, 0);
}

static void mesh_patches_are_consistent(void) {
  double flat = 0;  // shares of areas that patches do not fold away
  for (int kind = 0; kind < MESH_KINDS; ++kind) {
    nsvcd_mesh mesh = mesh_kind(kind);
    nsvcd__arena arena = nsvcd__arena_of(NULL);
    nsvcd__patches p;
    CHECK_EQ(nsvcd__patches_build(&mesh, 100, 1, &arena, &p), NSVCD_OK);
    CHECK_EQ(p.sample_count, 3200);
    CHECK_EQ(p.offsets[0], 0);
    CHECK_EQ(p.offsets[p.count], p.sample_count);
    double area = 0;
    double vector[3] = {0, 0, 0};
    double whole[3];
    for (size_t i = 0; i < p.count; ++i) {
      CHECK(p.offsets[i] < p.offsets[i + 1]);
      double mean[3] = {0, 0, 0};
      double samples = p.offsets[i + 1] - p.offsets[i];
      double reach = 0;
      for (size_t s = p.offsets[i]; s < p.offsets[i + 1]; ++s) {
        const float *x = &p.samples[s].x;
        const nsvcd__d3 at = nsvcd__d3_load(x);
        for (int k = 0; k < 3; ++k) mean[k] += (double)x[k] / samples;
        reach = fmax(reach, nsvcd__d3_distance2(at, nsvcd__d3_widen(p.centres[i])));
        CHECK_NEAR(nsvcd__f3_norm(p.normals[s]), 1, 1e-6);
      }
      const float *centre = &p.centres[i].x;
      const float *area_vector = &p.area_vectors[i].x;
      for (size_t k = 0; k < 3; ++k)
        CHECK_NEAR((double)centre[k], mean[k], 1e-6 * fabs(mean[k]) + 1e-12);
      // 0 of a patch with one sample
      CHECK_NEAR((double)p.sample_radii[i], sqrt(reach), 1e-6 * sqrt(reach));
      CHECK(p.radii[i] > 0 && nsvcd__is_finite(p.radii[i]));
      for (size_t k = 0; k < 3; ++k) vector[k] += (double)area_vector[k];
      area += (double)nsvcd__f3_norm(p.area_vectors[i]);
    }
    double total = nsvcd__mesh_area(&mesh);
    CHECK_LE(area, total * (1 + 1e-6));
    flat += area / total;
    mesh_area_vector(&mesh, whole);
    if (mesh_kind_closed[kind]) CHECK_LE(vector_length(whole), 1e-9 * total);
    for (int k = 0; k < 3; ++k) whole[k] -= vector[k];
    CHECK_LE(vector_length(whole), 1e-6 * total);
    CHECK_LE(p.piece_count, mesh.triangle_count + NSVCD__PIECES_PER_SAMPLE * p.sample_count);
    nsvcd__arena_free(&arena);
    nsvcd_mesh_free(&mesh, NULL);
  }
  printf("flat: %.4f of %d\n", flat, MESH_KINDS);
  CHECK(flat > 6.2);
}

// The search from a guess finds what looking at every centre finds.
static void mesh_nearest_centre_is_nearest(void) {
  int tried = 0;
  int wrong = 0;
  mesh_rng = 31;
  for (int kind = 0; kind < MESH_KINDS; ++kind) {
    nsvcd_mesh mesh = mesh_kind(kind);
    nsvcd__arena arena = nsvcd__arena_of(NULL);
    nsvcd__patches p;
    CHECK_EQ(nsvcd__patches_build(&mesh, kind % 2 ? 300 : 12, 1, &arena, &p), NSVCD_OK);
    for (int i = 0; i < 3000; ++i) {
      const float *from = &p.samples[mesh_below(p.sample_count)].x;
      double spread = i % 3 * 3 * (double)p.radii[0];
      float x[3];
      for (int k = 0; k < 3; ++k) x[k] = from[k] + (float)(spread * mesh_uniform(-1, 1));
      const nsvcd__f3 at = nsvcd__f3_load(x);
      uint32_t found = nsvcd__nearest_centre(&p, (uint32_t)mesh_below(p.count), at);
      uint32_t best = 0;
      for (uint32_t c = 1; c < p.count; ++c) {
        float d = nsvcd__to_centre2(&p, c, at);
        if (d < nsvcd__to_centre2(&p, best, at)) best = c;
      }
      tried++;
      wrong += found != best;
    }
    nsvcd__arena_free(&arena);
    nsvcd_mesh_free(&mesh, NULL);
  }
  printf("%d searches, %d wrong\n", tried, wrong);
  CHECK_EQ(wrong, 0);
}

static void mesh_patches_edge_cases(void) {
  nsvcd_mesh mesh = mesh_box(1, 1, 1);
  nsvcd__patches p;
  nsvcd__arena arena = nsvcd__arena_of(NULL);

  // No triangle has an area: then each is sampled alike, and all of them are covered.
  for (int i = 0; i < 36; i += 3) mesh.indices[i] = mesh.indices[i + 1];
  CHECK_EQ(nsvcd__patches_build(&mesh, 8, 1, &arena, &p), NSVCD_OK);
  for (size_t i = 0; i < 36; ++i) {
    double x[3];
    for (size_t k = 0; k < 3; ++k) x[k] = (double)mesh.positions[3 * mesh.indices[i] + k];
    CHECK(patches_cover(&p, x));
  }
  for (size_t i = 0; i < p.sample_count; ++i) CHECK_EQ(nsvcd__f3_norm(p.normals[i]), 0);
  nsvcd__arena_free(&arena);
  nsvcd_mesh_free(&mesh, NULL);

  // So small and so far out that all samples fall on a few floats: fewer patches, still covering.
  mesh = mesh_box(0.1, 0.1, 0.1);
  mesh_move(&mesh, 9e5f);
  CHECK_EQ(nsvcd__patches_build(&mesh, 512, 1, &arena, &p), NSVCD_OK);
  CHECK(p.count >= 1 && p.count < 512);
  for (size_t i = 0; i < 8; ++i) {
    double x[3];
    for (size_t k = 0; k < 3; ++k) x[k] = (double)mesh.positions[3 * i + k];
    CHECK(patches_cover(&p, x));
  }
  nsvcd__arena_free(&arena);
  nsvcd_mesh_free(&mesh, NULL);
}

// Hundreds of thousands of needles, each far longer than a patch is wide: the number of pieces
// stays bounded.
static void mesh_patches_of_slivers(void) {
  nsvcd_mesh mesh = mesh_fan(200000, 100, 0.1);
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  nsvcd__patches p;
  CHECK_EQ(nsvcd__patches_build(&mesh, 256, 1, &arena, &p), NSVCD_OK);
  printf("%d slivers, %d pieces\n", (int)mesh.triangle_count, (int)p.piece_count);
  CHECK_LE(p.piece_count, mesh.triangle_count + NSVCD__PIECES_PER_SAMPLE * p.sample_count);
  mesh_rng = 41;
  for (int i = 0; i < 5000; ++i) {
    double x[3] = {mesh_uniform(0, 100), 0, 0};
    x[1] = x[0] * mesh_uniform(0, 0.001) * 0.999;
    CHECK(patches_cover(&p, x));
  }
  nsvcd__arena_free(&arena);
  nsvcd_mesh_free(&mesh, NULL);
}

void test_patches(void) {
  RUN(mesh_samples_are_uniform);
  RUN(mesh_samples_scale);
  RUN(mesh_samples_lie_mid_stratum);
  RUN(mesh_farthest_points_are_farthest);
  RUN(mesh_centres_without_samples_are_dropped);
  RUN(mesh_patches_are_round);
  RUN(mesh_patches_cover_the_surface);
  RUN(mesh_patches_are_consistent);
  RUN(mesh_nearest_centre_is_nearest);
  RUN(mesh_patches_edge_cases);
  RUN(mesh_patches_of_slivers);
}

CHECK_ALONE(test_patches)
