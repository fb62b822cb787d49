// A large mesh in regions, of which the triangles are put together again, each of its component, and
// that one closed or open as sorting has it.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/mesh/mesh.h"
#include "../src/patches/regions.h"

#include "../examples/scenery/oracle.h"
#include "check.h"
#include "surface_scene.h"

void test_regions(void);

// ----------------------------------------------------------------------------------------- regions

static void regions_area_vector(double corners[3][3], double *out) {
  double ab[3], ac[3];
  oracle_sub(corners[1], corners[0], ab);
  oracle_sub(corners[2], corners[0], ac);
  oracle_cross(ab, ac, out);
}

static double regions_area(double corners[3][3]) {
  double vector[3];
  regions_area_vector(corners, vector);
  return oracle_length(vector);
}

// Is x in the triangle, to this much area? Then the triangles of its edges and x are the whole.
static int regions_in_triangle(double corners[3][3], const double *x, double tolerance) {
  double sum = 0;
  for (size_t k = 0; k < 3; k++) {
    double part[3][3];
    memcpy(part, corners, sizeof part);
    memcpy(part[k], x, sizeof part[k]);
    sum += regions_area(part);
  }
  return sum <= regions_area(corners) + tolerance;
}

// What the triangles of a mesh are, put together of their parts in all regions.
typedef struct regions_sum {
  const nsvcd_mesh *mesh;
  const nsvcd__regions *regions;
  double tolerance;    // of an area
  double *areas;       // (triangles, 3) vectors, of the parts so far
  size_t *parts;       // (triangles)
  size_t seeds;        // of components
  size_t bad;          // where anything is not as it should be
  size_t most, least;  // triangles of a region
} regions_sum;

static void regions_corners(const nsvcd_mesh *mesh, size_t t, double corners[3][3]) {
  for (size_t i = 0; i < 9; i++) {
    const size_t v = mesh->indices[3 * t + i / 3];
    corners[i / 3][i % 3] = (double)mesh->positions[3 * v + i % 3];
  }
}

// Vertex v of a region, as exactly as it is known.
static void regions_vertex(const nsvcd__region *region, size_t v, double *out) {
  const size_t firm = region->mesh.vertex_count - region->cut_count;
  for (size_t k = 0; k < 3; k++) out[k] = (double)region->mesh.positions[3 * v + k];
  if (v >= firm) {
    out[0] = region->cuts[v - firm].x;
    out[1] = region->cuts[v - firm].y;
    out[2] = region->cuts[v - firm].z;
  }
}

// The vertices are those of the mesh, and cuts are rounded; a seed is given once.
static void regions_add_vertices(nsvcd__region *region, regions_sum *sum) {
  const size_t firm = region->mesh.vertex_count - region->cut_count;
  for (size_t v = 0; v < region->mesh.vertex_count; v++) {
    double at[3];
    regions_vertex(region, v, at);
    for (size_t k = 0; k < 3; k++) {
      const float stored = region->mesh.positions[3 * v + k];
      sum->bad += stored < (float)at[k] || stored > (float)at[k];
      if (v >= firm || !region->vertices) continue;
      const float own = sum->mesh->positions[3 * (size_t)region->vertices[v] + k];
      sum->bad += memcmp(&stored, &own, sizeof own) != 0;
    }
    sum->seeds += region->seeds[v];
    region->seeds[v] = 0;
  }
}

static void regions_add_triangles(const nsvcd__region *region, const shells *parts,
                                  regions_sum *sum) {
  const double limit = sum->regions->longest_edge * (1 + 1e-9);
  size_t last = 0;
  for (size_t t = 0; t < region->mesh.triangle_count; t++) {
    const size_t id = region->ids[t] & NSVCD__NUMBER;
    const int encloses = region->ids[t] >> NSVCD__KIND_SHIFT >= NSVCD__CLOSED;
    double part[3][3], whole[3][3], vector[3];
    sum->bad += id >= sum->mesh->triangle_count || id < last;
    if (sum->bad) return;
    last = id;
    sum->bad += encloses != parts->closed[parts->part[sum->mesh->indices[3 * id]]];
    for (size_t k = 0; k < 3; k++) regions_vertex(region, region->mesh.indices[3 * t + k], part[k]);
    regions_corners(sum->mesh, id, whole);
    for (size_t k = 0; k < 3; k++) {
      double edge[3];
      oracle_sub(part[(k + 1) % 3], part[k], edge);
      sum->bad += oracle_length(edge) > limit;
      sum->bad += !regions_in_triangle(whole, part[k], sum->tolerance);
    }
    regions_area_vector(part, vector);
    for (size_t k = 0; k < 3; k++) sum->areas[3 * id + k] += vector[k];
    sum->parts[id]++;
  }
}

static void regions_check(const nsvcd_mesh *mesh, size_t patches) {
  shells components = shells_of(mesh);
  const double scale = surface_scale(mesh);
  nsvcd__regions r;
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  regions_sum sum;
  memset(&sum, 0, sizeof sum);
  sum.mesh = mesh;
  sum.regions = &r;
  sum.tolerance = 1e-12 * scale * scale;
  sum.areas = (double *)calloc(3 * mesh->triangle_count, sizeof(double));
  sum.parts = (size_t *)calloc(mesh->triangle_count, sizeof(size_t));
  CHECK(nsvcd__regions_build(mesh, patches, &arena, &r));
  CHECK_EQ(r.count, patches > 512 ? (patches + 255) / 256 : 1);
  CHECK_LE(r.triangle_count, mesh->triangle_count + r.most_cuts);
  CHECK(r.cut_count < r.most_cuts || r.count == 1);  // there was room for all halves
  for (size_t n = 0; n < r.count; n++) {
    nsvcd__region region;
    const nsvcd_result result = nsvcd__region_begin(&r, n, &arena, &region);
    if (result == NSVCD_ERROR_EMPTY) continue;
    CHECK_EQ(result, NSVCD_OK);
    regions_add_vertices(&region, &sum);
    regions_add_triangles(&region, &components, &sum);
    nsvcd__region_end(&r, &region);
  }
  CHECK_EQ(sum.bad, 0);
  CHECK_EQ(sum.seeds, components.count);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    double whole[3][3], vector[3];
    regions_corners(mesh, t, whole);
    regions_area_vector(whole, vector);
    oracle_sub(vector, sum.areas + 3 * t, vector);
    sum.bad += sum.parts[t] == 0 || oracle_length(vector) > sum.tolerance;
  }
  CHECK_EQ(sum.bad, 0);
  nsvcd__arena_free(&arena);
  shells_free(&components);
  free(sum.areas);
  free(sum.parts);
}

// No triangle is lost, none is there twice, large ones are there in halves, each of their component
// and in the order of the mesh.
static void regions_hold_the_mesh(void) {
  const size_t patches[5] = {1, 512, 513, 2100, 9000};
  for (int kind = 0; kind < SURFACE_KINDS; kind++) {
    nsvcd_mesh mesh = surface_kind(kind);
    const int failures = check.failures_in_test;
    for (size_t n = 0; n < 5; n++) regions_check(&mesh, patches[n]);
    if (check.failures_in_test > failures) printf("  kind %d\n", kind);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

// Half of what a region counts is its area, half its triangles: regions are about alike.
static void regions_are_alike(void) {
  double worst = 0;
  for (int kind = 0; kind < SURFACE_KINDS; kind++) {
    nsvcd_mesh mesh = surface_kind(kind);
    nsvcd__regions r;
    nsvcd__arena arena = nsvcd__arena_of(NULL);
    CHECK(nsvcd__regions_build(&mesh, 5000, &arena, &r));
    double area = 0;
    for (size_t t = 0; t < mesh.triangle_count; t++) {
      double corners[3][3];
      regions_corners(&mesh, t, corners);
      area += regions_area(corners);
    }
    double most = 0;
    for (size_t n = 0; n < r.count; n++) {
      nsvcd__region region;
      if (nsvcd__region_begin(&r, n, &arena, &region)) continue;
      double own = 0;
      for (size_t t = 0; t < region.mesh.triangle_count; t++) {
        double corners[3][3];
        regions_corners(&region.mesh, t, corners);
        own += regions_area(corners);
      }
      const double fraction = (double)region.mesh.triangle_count / (double)r.triangle_count;
      most = fmax(most, 0.5 * (own / area + fraction) * (double)r.count);
      nsvcd__region_end(&r, &region);
    }
    worst = fmax(worst, most);
    nsvcd__arena_free(&arena);
    nsvcd_mesh_free(&mesh, NULL);
  }
  printf("  the largest region has %.2f of the mean\n", worst);
  CHECK_LE(worst, 1.5);
}

void test_regions(void) {
  RUN(regions_hold_the_mesh);
  RUN(regions_are_alike);
}

CHECK_ALONE(test_regions)
