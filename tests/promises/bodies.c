// What src/interface/bodies.h promises, a test each: a mesh becomes a blob, and what it says of
// itself is so.
#include "scene.h"

void promises_bodies(void);

static void a_mesh_is_always_the_same_bytes(void) {
  const nsvcd_body *first = box(0.3f, 0.2f, 0.1f);
  const nsvcd_body *second = box(0.3f, 0.2f, 0.1f);
  const size_t size = nsvcd_body_describe(first).size;
  CHECK_EQ(nsvcd_body_describe(second).size, size);
  CHECK(!memcmp(first, second, size));
  nsvcd_body_free(first, NULL);
  nsvcd_body_free(second, NULL);
}

static void a_body_is_encoded_into_the_callers_memory(void) {
  static NSVCD_MEMORY(memory, NSVCD_BODY_BYTES(16));
  const nsvcd_encode_options options = {.patches = 16, .no_triangles = 1};
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  const nsvcd_body *body = NULL;
  CHECK_LE(nsvcd_body_size(16), sizeof memory);
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory, 8, &body), NSVCD_ERROR_WORKSPACE);
  CHECK(body == NULL);
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, memory, sizeof memory, &body), NSVCD_OK);
  CHECK((const void *)body == (const void *)memory);
  CHECK_LE(nsvcd_body_describe(body).patches, 16);
  nsvcd_mesh_free(&mesh, NULL);
}

static void a_body_survives_a_copy(void) {
  const nsvcd_body *mug = box(0.1f, 0.1f, 0.12f);
  const size_t size = nsvcd_body_describe(mug).size;
  void *copy = malloc(size);
  const nsvcd_body *loaded = NULL, *trusted = NULL;
  memcpy(copy, mug, size);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_OK);
  CHECK_EQ(nsvcd_body_trust(copy, size, &trusted), NSVCD_OK);
  CHECK(loaded == copy && trusted == copy);
  CHECK_EQ(nsvcd_body_load(copy, size - 1, &loaded), NSVCD_ERROR_BODY);
  CHECK_EQ(nsvcd_body_trust(copy, size - 1, &trusted), NSVCD_ERROR_BODY);
  free(copy);
  nsvcd_body_free(mug, NULL);
}

static void a_body_with_any_byte_changed_is_refused(void) {
  const nsvcd_body *mug = box(0.1f, 0.1f, 0.12f);
  const size_t size = nsvcd_body_describe(mug).size;
  unsigned char *copy = (unsigned char *)malloc(size);
  memcpy(copy, mug, size);
  for (size_t i = 0; i < size; i++) {
    const nsvcd_body *loaded = NULL;
    copy[i] ^= 0x10;
    const nsvcd_result result = nsvcd_body_load(copy, size, &loaded);
    CHECK(result == NSVCD_ERROR_BODY || result == NSVCD_ERROR_VERSION);
    CHECK(loaded == NULL);
    copy[i] ^= 0x10;
  }
  memcpy(copy, memcmp(copy, "NSVB", 4) ? "NSVB" : "BVSN", 4);  // of the other byte order
  const nsvcd_body *loaded = NULL;
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_VERSION);
  free(copy);
  nsvcd_body_free(mug, NULL);
}

static void what_a_body_says_of_itself_is_so(void) {
  nsvcd_mesh mesh = box_mesh(0.3f, 0.2f, 0.1f);
  const nsvcd_body *body = body_of(box_mesh(0.3f, 0.2f, 0.1f), NULL);
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  CHECK(facts.triangles == 12 && facts.components == 1 && facts.open_components == 0);
  CHECK(facts.quantum == 0 && !facts.latents && !facts.open);
  for (size_t i = 0; i < mesh.vertex_count; i++) {
    const float *p = mesh.positions + 3 * i;
    int covered = 0;
    for (uint32_t patch = 0; patch <= facts.patches; patch++) {
      const int is_last = patch == facts.patches;  // the sphere of the whole
      float c[3] = {facts.centre[0], facts.centre[1], facts.centre[2]}, radius = facts.radius;
      CHECK_EQ(nsvcd_body_patch(body, patch, c, &radius), !is_last);
      const double x = p[0] - c[0], y = p[1] - c[1], z = p[2] - c[2];
      const int is_in = sqrt(x * x + y * y + z * z) <= (double)radius + 1e-6;
      if (is_last) CHECK(is_in);
      covered += is_in && !is_last;
    }
    CHECK(covered > 0);
  }
  CHECK_EQ(nsvcd_body_describe(NULL).size, 0);
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_body_free(body, NULL);
}

static void patches_are_as_many_as_asked_for(void) {
  const nsvcd_encode_options few = {.patches = 20}, fine = {.patch_radius = 0.03f};
  const nsvcd_body *a = body_of(box_mesh(1, 1, 1), &few);
  const nsvcd_body *b = body_of(box_mesh(0.2f, 0.2f, 0.2f), &fine);
  CHECK_EQ(nsvcd_body_describe(a).patches, 20);
  CHECK_NEAR(nsvcd_body_describe(b).mean_patch_radius, 0.03, 0.015);
  nsvcd_body_free(a, NULL);
  nsvcd_body_free(b, NULL);
}

static void what_is_not_closed_is_told(void) {
  const nsvcd_encode_options said = {.open = 1};
  const nsvcd_body *bin = body_of(box_mesh_of(1, 1, 1, OPEN_BOX_FACES), NULL);
  const nsvcd_body *open = body_of(box_mesh_of(1, 1, 1, OPEN_BOX_FACES), &said);
  const nsvcd_body_facts facts = nsvcd_body_describe(bin);
  CHECK(facts.components == 1 && facts.open_components == 1 && facts.open_edges == 4);
  CHECK(!facts.open && nsvcd_body_describe(open).open);
  nsvcd_body_free(bin, NULL);
  nsvcd_body_free(open, NULL);
}

static void a_scaled_body_is_that_of_the_scaled_mesh(void) {
  const nsvcd_body *small = box(0.1f, 0.2f, 0.3f);
  const nsvcd_body *large = box(0.2f, 0.4f, 0.6f);
  const size_t size = nsvcd_body_describe(small).size;
  void *memory = malloc(size);
  const nsvcd_body *scaled = NULL;
  CHECK_EQ(nsvcd_body_scale(small, 2, memory, size, &scaled), NSVCD_OK);
  CHECK_NEAR(nsvcd_body_describe(scaled).radius, nsvcd_body_describe(large).radius, 1e-5);
  // Each stops 1 mm before a post.
  const nsvcd_body *post = box(0.1f, 0.1f, 2);
  const nsvcd_pose poses[2] = {at(-1, 0, 0), at(-0.151f, 0, 0)};
  nsvcd_question question = question_about(scaled, poses, 2, post);
  CHECK_EQ(verdict_of(&question), NSVCD_FREE);
  question.clearance = 0.0011f;
  CHECK_EQ(verdict_of(&question), NSVCD_HIT);
  CHECK_EQ(nsvcd_body_scale(small, 0, memory, size, &scaled), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_body_scale(small, 2, memory, size - 8, &scaled), NSVCD_ERROR_WORKSPACE);
  free(memory);
  nsvcd_body_free(post, NULL);
  nsvcd_body_free(large, NULL);
  nsvcd_body_free(small, NULL);
}

// Spheres, capsules, boxes with round edges, and clouds of points are exact: 1 m from a sphere.
static void round_shapes_are_as_far_apart_as_geometry_says(void) {
  const float from[3] = {0, 0, -1}, to[3] = {0, 0, 1}, half[3] = {0.2f, 0.2f, 0.2f};
  const float points[6] = {0, 0, 0, 0, 5, 0};
  const nsvcd_body *shapes[4] = {NULL, NULL, NULL, NULL};
  CHECK_EQ(nsvcd_encode_sphere(0.2f, NULL, &shapes[0]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_capsule(from, to, 0.2f, NULL, &shapes[1]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_box(half, 0.05f, NULL, &shapes[2]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_cloud(points, 2, 0.2f, NULL, &shapes[3]), NSVCD_OK);
  const nsvcd_pose pose = at(1.5f, 0, 0);
  const nsvcd_body *ball = NULL;
  CHECK_EQ(nsvcd_encode_sphere(0.3f, NULL, &ball), NSVCD_OK);
  for (int i = 0; i < 4; i++) {
    nsvcd_question question = question_about(ball, &pose, 1, shapes[i]);
    question.ask = NSVCD_ASK_DISTANCE;
    question.to = 1e-3f;
    const nsvcd_range distance = answer_to(&question).distance;
    CHECK(distance.low <= 1 + 1e-6f && distance.high >= 1 - 1e-6f);
    CHECK_LE(distance.high - distance.low, 1e-3 + 3e-6);  // and float's roundings
    nsvcd_body_free(shapes[i], NULL);
  }
  nsvcd_body_free(ball, NULL);
  CHECK_EQ(nsvcd_encode_sphere(0, NULL, &ball), NSVCD_ERROR_RADIUS);
}

static int stop_at_once(float done, void *user) {
  CHECK(done >= 0 && done <= 1);
  return *(int *)user;
}
static void encoding_tells_how_much_is_done_and_can_be_cancelled(void) {
  int stops = 1;
  const nsvcd_encode_options options = {.progress = stop_at_once, .user = &stops};
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_ERROR_CANCELLED);
  CHECK(body == NULL);
  stops = 0;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_OK);
  nsvcd_body_free(body, NULL);
  nsvcd_mesh_free(&mesh, NULL);
}

static void bodies_are_as_small_and_as_large_as_is_said(void) {
  const float least = 2.4f * NSVCD_MIN_RADIUS, most = 1.9f * NSVCD_MAX_COORDINATE;
  const float sizes[4] = {least, most, 0.1f * NSVCD_MIN_RADIUS, 2.1f * NSVCD_MAX_COORDINATE};
  const nsvcd_result results[4] = {NSVCD_OK, NSVCD_OK, NSVCD_ERROR_EMPTY, NSVCD_ERROR_NUMBER};
  for (int i = 0; i < 4; i++) {
    nsvcd_mesh mesh = box_mesh(1, 1, 1);
    const nsvcd_body *body = NULL;
    for (size_t k = 0; k < 3 * mesh.vertex_count; k++) mesh.positions[k] *= sizes[i];
    CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), results[i]);
    nsvcd_body_free(body, NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
}

static void a_mesh_that_cannot_be_is_refused(void) {
  nsvcd_mesh mesh = box_mesh(1, 1, 1);
  const nsvcd_encode_options options = {.patches = NSVCD_MAX_PATCHES + 1};
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_ERROR_PATCHES);
  mesh.indices[5] = BOX_CORNERS;
  CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), NSVCD_ERROR_INDEX);
  mesh.indices[5] = 0;
  mesh.positions[7] = HUGE_VALF;
  CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), NSVCD_ERROR_NUMBER);
  for (size_t i = 0; i < 3 * BOX_CORNERS; i++) mesh.positions[i] = 1;
  CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), NSVCD_ERROR_EMPTY);
  CHECK(body == NULL);
  nsvcd_mesh_free(&mesh, NULL);
}

void promises_bodies(void) {
  RUN(a_mesh_is_always_the_same_bytes);
  RUN(a_body_is_encoded_into_the_callers_memory);
  RUN(a_body_survives_a_copy);
  RUN(a_body_with_any_byte_changed_is_refused);
  RUN(what_a_body_says_of_itself_is_so);
  RUN(patches_are_as_many_as_asked_for);
  RUN(what_is_not_closed_is_told);
  RUN(a_scaled_body_is_that_of_the_scaled_mesh);
  RUN(round_shapes_are_as_far_apart_as_geometry_says);
  RUN(encoding_tells_how_much_is_done_and_can_be_cancelled);
  RUN(bodies_are_as_small_and_as_large_as_is_said);
  RUN(a_mesh_that_cannot_be_is_refused);
}

CHECK_ALONE(promises_bodies)
