// nsvcd_encode through the public API: the same bytes again, sizes, patches of a radius, bad input, no
// memory.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/body/trust.h"
#include "../src/body/encode.h"
#include "../src/entry/processor.h"

#include "failing_heap.h"
#include "query_scene.h"

void test_encoding(void);

static void query_bodies_are_small(void) {
  nsvcd_mesh mesh = query_solid(3, 0.3);
  query_memory memory;
  const nsvcd_body *body = query_encode(&mesh, NSVCD_SMALL_PATCHES, &memory);
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  CHECK_EQ(facts.patches, NSVCD_SMALL_PATCHES);
  CHECK_LE(facts.size, 65535);
  CHECK_LE(nsvcd_body_size(NSVCD_SMALL_PATCHES), 65535);
  CHECK_EQ(nsvcd_body_size(0), 0);
  CHECK_EQ(nsvcd_body_size(NSVCD_MAX_PATCHES + 1), 0);
  query_release(&memory);
  nsvcd_mesh_free(&mesh, NULL);
}

static void query_patch_radius_is_honoured(void) {
  nsvcd_mesh mesh = query_solid(7, 0.3);
  size_t fewer = NSVCD_SMALL_PATCHES + 1;
  const float wanted[3] = {0.025f, 0.04f, 0.07f};
  for (int i = 0; i < 3; i++) {
    nsvcd_encode_options options = {.patch_radius = wanted[i], .no_triangles = 1};
    size_t size = nsvcd_body_size(NSVCD_SMALL_PATCHES);
    query_memory memory = query_reserve(size);
    const nsvcd_body *body = NULL;
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory.at, size, &body), NSVCD_OK);
    if (body) {
      nsvcd_body_facts facts = nsvcd_body_describe(body);
      CHECK_LE(facts.patches, fewer - 1);  // larger patches, fewer of them
      CHECK(facts.mean_patch_radius > 0.6f * wanted[i] &&
            facts.mean_patch_radius < 1.6f * wanted[i]);
      fewer = facts.patches;
    }
    query_release(&memory);
  }
  nsvcd_mesh_free(&mesh, NULL);
}

// A finer mesh has more patches, of 50 triangles in the mean, from 192 to 512.
static void query_finer_meshes_have_more_patches(void) {
  const int segments[4] = {40, 80, 128, 256};  // 5,120 to 32,768 triangles
  const size_t wanted[4] = {192, 204, 327, 512};
  for (int i = 0; i < 4; i++) {
    shapes_mesh torus;
    memset(&torus, 0, sizeof torus);
    shapes_torus(&torus, 0.1, 0.03, segments[i], 64);
    nsvcd_mesh mesh = query_mesh(&torus, 1);
    shapes_free(&torus);
    CHECK_EQ(mesh.triangle_count, 128 * segments[i]);
    const nsvcd_body *body = NULL;
    CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), NSVCD_OK);
    CHECK_EQ(nsvcd_body_describe(body).patches, wanted[i]);
    nsvcd_body_free(body, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

// nsvcd_encode with one thing wrong leaves *body alone.
static void query_encode_refuses(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                 void *memory, size_t capacity, nsvcd_result expected) {
  const nsvcd_body *const mark = (const nsvcd_body *)(const void *)&expected;
  const nsvcd_body *body = mark;
  CHECK_EQ(nsvcd_encode(mesh, options, NULL, memory, capacity, &body), expected);
  CHECK(body == mark);
}

// Without memory the body comes from the allocator, and is the same.
static void query_encode_allocates(void) {
  nsvcd_mesh mesh = query_box(0.1, 0.2, 0.3);
  for (int without = 0; without < 2; without++) {
    const nsvcd_encode_options options = {.patches = 64, .no_triangles = without};
    const nsvcd_body *body = NULL;
    const nsvcd_body *same = NULL;
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_OK);
    const nsvcd_body_facts facts = nsvcd_body_describe(body);
    query_memory memory = query_reserve(facts.size);
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory.at, facts.size, &same), NSVCD_OK);
    CHECK(memcmp(body, same, facts.size) == 0);
    CHECK_EQ(facts.triangles, without ? 0 : mesh.triangle_count);
    query_encode_refuses(&mesh, &options, memory.at, facts.size - 1, NSVCD_ERROR_WORKSPACE);
    nsvcd_body_free(body, NULL);
    query_release(&memory);
  }
  nsvcd_mesh_free(&mesh, NULL);
}

static void query_encode_refuses_bad_input(void) {
  nsvcd_mesh mesh = query_box(0.1, 0.1, 0.1);
  nsvcd_mesh bad = mesh;
  size_t size = nsvcd_body_size(64);
  query_memory memory = query_reserve(nsvcd_body_size(NSVCD_SMALL_PATCHES) + QUERY_ALIGN);
  nsvcd_encode_options options = {.patches = 64, .no_triangles = 1};
  nsvcd_encode_options too_many = {.patches = NSVCD_MAX_PATCHES + 1, .no_triangles = 1};
  nsvcd_encode_options negative = {.patch_radius = -1, .no_triangles = 1};
  nsvcd_encode_options nan = {.patch_radius = NAN, .no_triangles = 1};
  query_encode_refuses(NULL, &options, memory.at, size, NSVCD_ERROR_ARGUMENT);
  query_encode_refuses(&mesh, &too_many, memory.at, size, NSVCD_ERROR_PATCHES);
  query_encode_refuses(&mesh, &negative, memory.at, size, NSVCD_ERROR_PATCHES);
  query_encode_refuses(&mesh, &nan, memory.at, size, NSVCD_ERROR_PATCHES);
  query_encode_refuses(&mesh, &options, memory.at, size - 1, NSVCD_ERROR_WORKSPACE);
  query_encode_refuses(&mesh, &options, (char *)memory.at + 4, size, NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory.at, size, NULL), NSVCD_ERROR_ARGUMENT);
  bad.triangle_count = 0;
  query_encode_refuses(&bad, &options, memory.at, size, NSVCD_ERROR_EMPTY);
  bad = mesh;
  bad.positions = NULL;
  query_encode_refuses(&bad, &options, memory.at, size, NSVCD_ERROR_ARGUMENT);
  bad = mesh;
  bad.vertex_count = 5;  // indices beyond
  query_encode_refuses(&bad, &options, memory.at, size, NSVCD_ERROR_INDEX);
  float kept = mesh.positions[4];
  mesh.positions[4] = NAN;
  query_encode_refuses(&mesh, &options, memory.at, size, NSVCD_ERROR_NUMBER);
  mesh.positions[4] = 2 * NSVCD_MAX_COORDINATE;
  query_encode_refuses(&mesh, &options, memory.at, size, NSVCD_ERROR_NUMBER);
  mesh.positions[4] = kept;
  for (size_t i = 0; i < 3 * mesh.vertex_count; i++) mesh.positions[i] = 0.1f;  // no area
  query_encode_refuses(&mesh, &options, memory.at, size, NSVCD_ERROR_EMPTY);
  query_release(&memory);
  nsvcd_mesh_free(&mesh, NULL);
}

void test_encoding(void) {
  RUN(query_bodies_are_small);
  RUN(query_patch_radius_is_honoured);
  RUN(query_finer_meshes_have_more_patches);
  RUN(query_encode_allocates);
  RUN(query_encode_refuses_bad_input);
}

CHECK_ALONE(test_encoding)
