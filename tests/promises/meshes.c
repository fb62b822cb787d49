// What src/interface/meshes.h promises, a test each: files and faces become triangles in metres.
#include "scene.h"

void promises_meshes(void);

static const char cube[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\nf 5 6 8 7\n";

static const char corner[] =
    "solid corner\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 1 0 0\nendloop\nendfacet\n"
    "endsolid corner\n";

// m^2; counter-clockwise it is positive.
static double area_from_above(const nsvcd_mesh *mesh, size_t triangle) {
  const float *p = mesh->positions + 3 * mesh->indices[3 * triangle];
  const float *q = mesh->positions + 3 * mesh->indices[3 * triangle + 1];
  const float *r = mesh->positions + 3 * mesh->indices[3 * triangle + 2];
  return 0.5 * (double)((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
}

static void obj_faces_of_any_size_become_triangles(void) {
  static const char arrow[] = "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n";
  nsvcd_mesh mesh;
  CHECK_EQ(nsvcd_obj_parse(cube, strlen(cube), NULL, &mesh, NULL), NSVCD_OK);
  CHECK_EQ(mesh.vertex_count, 8);
  CHECK_EQ(mesh.triangle_count, 12);
  nsvcd_mesh_free(&mesh, NULL);
  CHECK(mesh.positions == NULL);

  // A concave face is cut within itself: its area, by the triangles, is 1 m^2.
  double area = 0;
  CHECK_EQ(nsvcd_obj_parse(arrow, strlen(arrow), NULL, &mesh, NULL), NSVCD_OK);
  CHECK_EQ(mesh.triangle_count, 2);
  for (size_t i = 0; i < mesh.triangle_count; i++) {
    CHECK(area_from_above(&mesh, i) > 0);
    area += area_from_above(&mesh, i);
  }
  CHECK_NEAR(area, 1, 1e-6);
  nsvcd_mesh_free(&mesh, NULL);
}

static void an_obj_is_refused_with_its_line(void) {
  static const struct {
    const char *text;
    nsvcd_result result;
    size_t line;
  } faults[] = {
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", NSVCD_ERROR_INDEX, 4},
      {"v 0 0 0\nv 1 0 zero\nv 0 1 0\nf 1 2 3\n", NSVCD_ERROR_SYNTAX, 2},
      {"v 0 0 0\n\nv 1 0 1e7\nv 0 1 0\nf 1 2 3\n", NSVCD_ERROR_NUMBER, 3},
      {"v 0 0 0\nv 1 0 0\nf 1 2\n", NSVCD_ERROR_SYNTAX, 3},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", NSVCD_ERROR_EMPTY, 0},
  };
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
    nsvcd_mesh mesh = {NULL, NULL, 7, 9};
    size_t line = 99;
    const char *text = faults[i].text;
    CHECK_EQ(nsvcd_obj_parse(text, strlen(text), NULL, &mesh, &line), faults[i].result);
    CHECK_EQ(line, faults[i].line);
    CHECK(mesh.vertex_count == 7 && mesh.triangle_count == 9);  // as it was
  }
}

// Wherever a file ends, it is refused or a mesh. No byte past its end is read: a sanitizer looks.
static void a_file_may_end_anywhere(void) {
  static const char obj[] =
      "v 0 0 0 # a \\\nv 1.5e0 0 0 1\nv +1 1 -1e-1 .1 .2 .3\r\nv 0 1 -0\nvt 0 0\nvn 0 0 1\n"
      "o a\nf 1/1/1 2/1/1 3//1 4/1/\nf 1 2 \\\n 3\nf -1 -2 -3\nv -1 +1 -1e-1";
  const char *const texts[] = {obj, corner};
  const size_t vertices[] = {5, 4};
  const size_t triangles[] = {4, 2};
  for (size_t n = 0; n < 2; n++) {
    const size_t whole = strlen(texts[n]);
    for (size_t size = 1; size <= whole; size++) {
      char *text = (char *)malloc(size);
      nsvcd_mesh mesh = {NULL, NULL, 0, 0};
      memcpy(text, texts[n], size);
      const nsvcd_result result = n ? nsvcd_stl_parse(text, size, NULL, &mesh, NULL)
                                    : nsvcd_obj_parse(text, size, NULL, &mesh, NULL);
      CHECK(size < whole || !result);
      CHECK_EQ(mesh.positions == NULL, result != NSVCD_OK);
      CHECK_LE(mesh.vertex_count, vertices[n]);
      CHECK_LE(mesh.triangle_count, triangles[n]);
      for (size_t i = 0; i < 3 * mesh.triangle_count; i++)
        CHECK(mesh.indices[i] < mesh.vertex_count);
      nsvcd_mesh_free(&mesh, NULL);
      free(text);
    }
  }
}

static void stl_corners_at_one_place_are_one_vertex(void) {
  nsvcd_mesh mesh;
  size_t line;
  CHECK_EQ(nsvcd_stl_parse(corner, strlen(corner), NULL, &mesh, &line), NSVCD_OK);
  CHECK_EQ(mesh.triangle_count, 2);
  CHECK_EQ(mesh.vertex_count, 4);
  nsvcd_mesh_free(&mesh, NULL);
}

static void a_format_is_known_by_what_a_file_holds(void) {
  nsvcd_mesh mesh;
  size_t line;
  CHECK_EQ(nsvcd_mesh_parse(corner, strlen(corner), NULL, NULL, &mesh, &line), NSVCD_OK);
  CHECK_EQ(mesh.triangle_count, 2);
  nsvcd_mesh_free(&mesh, NULL);
  CHECK_EQ(nsvcd_mesh_parse(cube, strlen(cube), NULL, NULL, &mesh, &line), NSVCD_OK);
  CHECK_EQ(mesh.triangle_count, 12);
  nsvcd_mesh_free(&mesh, NULL);
  CHECK_EQ(nsvcd_obj_parse(corner, strlen(corner), NULL, &mesh, &line), NSVCD_ERROR_FORMAT);
  CHECK_EQ(nsvcd_stl_parse(cube, strlen(cube), NULL, &mesh, &line), NSVCD_ERROR_FORMAT);
}

// Of a map in millimetres, whose coordinates are billions, the millimetre is kept.
static void a_files_numbers_become_metres_in_double(void) {
  static const char map[] = "v 5400000001 0 0\nv 5400001000 0 0\nv 5400000000 1000 0\nf 1 2 3\n";
  const nsvcd_mesh_options options = {NSVCD_MESH_OBJ, {5.4e9, 0, 0}, 0.001};
  nsvcd_mesh mesh;
  size_t line;
  CHECK_EQ(nsvcd_mesh_parse(map, strlen(map), &options, NULL, &mesh, &line), NSVCD_OK);
  CHECK_NEAR(mesh.positions[0], 0.001, 1e-9);
  CHECK_NEAR(mesh.positions[3], 1, 1e-7);
  nsvcd_mesh_free(&mesh, NULL);
  CHECK_EQ(nsvcd_mesh_parse(map, strlen(map), NULL, NULL, &mesh, &line), NSVCD_ERROR_NUMBER);
}

static void a_file_is_read_as_its_text(void) {
  static const char *const path = "build/promises.mesh";
  const struct {
    const char *text;
    nsvcd_result (*load)(const char *, const nsvcd_allocator *, nsvcd_mesh *, size_t *);
    size_t triangles;
  } files[] = {{cube, nsvcd_obj_load, 12}, {corner, nsvcd_stl_load, 2}};
  for (int i = 0; i < 2; i++) {
    nsvcd_mesh mesh;
    size_t line;
    FILE *file = fopen(path, "w");
    CHECK(file && fputs(files[i].text, file) >= 0 && !fclose(file));
    CHECK_EQ(files[i].load(path, NULL, &mesh, &line), NSVCD_OK);
    CHECK_EQ(mesh.triangle_count, files[i].triangles);
    nsvcd_mesh_free(&mesh, NULL);
    CHECK_EQ(nsvcd_mesh_load(path, NULL, NULL, &mesh, &line), NSVCD_OK);
    CHECK_EQ(mesh.triangle_count, files[i].triangles);
    nsvcd_mesh_free(&mesh, NULL);
    remove(path);
    CHECK_EQ(files[i].load(path, NULL, &mesh, &line), NSVCD_ERROR_IO);
  }
}

static void faces_of_the_caller_are_cut_as_those_of_a_file(void) {
  nsvcd_mesh ours = box_mesh(1, 1, 1);
  nsvcd_mesh read;
  CHECK_EQ(nsvcd_obj_parse(cube, strlen(cube), NULL, &read, NULL), NSVCD_OK);
  CHECK_EQ(ours.triangle_count, read.triangle_count);
  CHECK(!memcmp(ours.indices, read.indices, 3 * read.triangle_count * sizeof(uint32_t)));
  nsvcd_mesh_free(&read, NULL);

  const uint32_t two = 2, five = 5;
  nsvcd_faces faces = {ours.positions, box_faces, &two, BOX_CORNERS, 2, 1};
  CHECK_EQ(nsvcd_mesh_of_faces(&faces, NULL, &read), NSVCD_ERROR_SIZES);
  faces.sizes = &five;
  CHECK_EQ(nsvcd_mesh_of_faces(&faces, NULL, &read), NSVCD_ERROR_SIZES);
  faces.sizes = NULL;
  faces.corner_count = 3;
  faces.vertex_count = 2;
  CHECK_EQ(nsvcd_mesh_of_faces(&faces, NULL, &read), NSVCD_ERROR_INDEX);
  nsvcd_mesh_free(&ours, NULL);
}

static void a_mesh_cut_at_a_box_is_all_of_it_that_is_within(void) {
  nsvcd_mesh floor = box_mesh(10, 10, 1);
  nsvcd_mesh part;
  const float low[3] = {1, 1, 0}, high[3] = {2, 3, 1};
  const float above[3] = {1, 1, 2}, higher[3] = {2, 2, 3};
  double area = 0;
  CHECK_EQ(nsvcd_mesh_cut(&floor, low, high, NULL, &part), NSVCD_OK);
  for (size_t i = 0; i < 3 * part.vertex_count; i++)
    CHECK(part.positions[i] >= low[i % 3] && part.positions[i] <= high[i % 3]);
  for (size_t i = 0; i < part.triangle_count; i++) area += area_from_above(&part, i);
  CHECK_NEAR(area, 2, 1e-6);  // of its upper face
  nsvcd_mesh_free(&part, NULL);
  CHECK_EQ(nsvcd_mesh_cut(&floor, above, higher, NULL, &part), NSVCD_ERROR_EMPTY);
  CHECK_EQ(nsvcd_mesh_cut(&floor, high, low, NULL, &part), NSVCD_ERROR_BOX);
  nsvcd_mesh_free(&floor, NULL);
}

static void a_hull_holds_its_points(void) {
  float points[3 * 60];
  nsvcd_mesh hull;
  for (size_t i = 0; i < 60; i++) {
    points[3 * i] = (float)(i % 5);
    points[3 * i + 1] = (float)(i / 5 % 4);
    points[3 * i + 2] = (float)(i / 20);
  }
  CHECK_EQ(nsvcd_mesh_hull(points, 60, NULL, &hull), NSVCD_OK);
  CHECK_EQ(hull.vertex_count, 8);  // those of a box of 4 x 3 x 2
  CHECK_EQ(hull.triangle_count, 12);
  double area = 0;
  for (size_t i = 0; i < hull.triangle_count; i++) area += fmax(area_from_above(&hull, i), 0);
  CHECK_NEAR(area, 12, 1e-9);
  nsvcd_mesh_free(&hull, NULL);
  CHECK_EQ(nsvcd_mesh_hull(points, 20, NULL, &hull), NSVCD_ERROR_EMPTY);  // in a plane
  points[7] = 2e6f;
  CHECK_EQ(nsvcd_mesh_hull(points, 60, NULL, &hull), NSVCD_ERROR_NUMBER);
  CHECK_EQ(nsvcd_mesh_hull(NULL, 60, NULL, &hull), NSVCD_ERROR_ARGUMENT);
}

static void heights_are_a_surface_with_holes(void) {
  const float heights[3 * 4] = {0, 0, 1, NAN, 0, 0, 1, 1, 0, 0, 1, 1};
  const float step[2] = {2, 1}, none[2] = {2, 0};
  nsvcd_mesh mesh;
  double area = 0;
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 3, 4, step, NULL, &mesh), NSVCD_OK);
  CHECK_EQ(mesh.vertex_count, 11);
  CHECK_EQ(mesh.triangle_count, 11);  // the corner is cut off
  for (size_t i = 0; i < mesh.triangle_count; i++) {
    CHECK(area_from_above(&mesh, i) > 0);
    area += area_from_above(&mesh, i);
  }
  CHECK_NEAR(area, 6 * 2 - 1, 1e-9);
  nsvcd_mesh_free(&mesh, NULL);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 3, 4, none, NULL, &mesh), NSVCD_ERROR_SCALE);
  CHECK_EQ(nsvcd_mesh_of_heights(heights, 1, 4, step, NULL, &mesh), NSVCD_ERROR_EMPTY);
}

// An allocator that has no more after so many.
typedef struct little_memory {
  int left, given;
} little_memory;
static void *take(size_t size, void *user) {
  little_memory *m = (little_memory *)user;
  void *memory = m->left-- > 0 ? malloc(size) : NULL;
  m->given += memory != NULL;
  return memory;
}
static void give(void *memory, void *user) {
  ((little_memory *)user)->given -= memory != NULL;
  free(memory);
}

// A file is read, cut at a box, and becomes a body: a small one, one for the network, one of
// regions, one with balls.
static nsvcd_result all_of_it(const char *text, const nsvcd_encode_options *options,
                              const nsvcd_allocator *allocator, nsvcd_mesh meshes[2],
                              const nsvcd_body **body) {
  static const float low[3] = {-1, -1, -1}, high[3] = {9, 9, 0.5f};
  size_t line = 99;
  nsvcd_result result = nsvcd_mesh_parse(text, strlen(text), NULL, allocator, &meshes[0], &line);
  CHECK_EQ(line, 0);
  if (!result) result = nsvcd_mesh_cut(&meshes[0], low, high, allocator, &meshes[1]);
  return result ? result : nsvcd_encode(&meshes[1], options, allocator, NULL, 0, body);
}
static void memory_that_runs_out_is_told_and_nothing_leaks(void) {
  static const char arrow[] = "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n";
  static const char *const texts[4] = {arrow, cube, corner, cube};
  static const nsvcd_encode_options kinds[4] = {
      {.latents = 1}, {.no_triangles = 1}, {.latents = 1, .patches = 513}, {.balls = 20}};
  for (int kind = 0; kind < 4; kind++) {
    nsvcd_result result = NSVCD_ERROR_MEMORY;
    int many = 0;
    for (; result; many++) {
      little_memory memory = {many, 0};
      const nsvcd_allocator allocator = {take, give, &memory};
      nsvcd_mesh meshes[2] = {{NULL, NULL, 0, 0}, {NULL, NULL, 0, 0}};
      const nsvcd_body *body = NULL;
      result = all_of_it(texts[kind], &kinds[kind], &allocator, meshes, &body);
      CHECK(result == (body ? NSVCD_OK : NSVCD_ERROR_MEMORY));
      nsvcd_body_free(body, &allocator);
      for (int k = 0; k < 2; k++) nsvcd_mesh_free(&meshes[k], &allocator);
      CHECK_EQ(memory.given, 0);
    }
    CHECK(many > 20);  // that many allocations failed, one after another
  }
}

void promises_meshes(void) {
  RUN(obj_faces_of_any_size_become_triangles);
  RUN(an_obj_is_refused_with_its_line);
  RUN(a_file_may_end_anywhere);
  RUN(stl_corners_at_one_place_are_one_vertex);
  RUN(a_format_is_known_by_what_a_file_holds);
  RUN(a_files_numbers_become_metres_in_double);
  RUN(a_file_is_read_as_its_text);
  RUN(faces_of_the_caller_are_cut_as_those_of_a_file);
  RUN(a_mesh_cut_at_a_box_is_all_of_it_that_is_within);
  RUN(a_hull_holds_its_points);
  RUN(heights_are_a_surface_with_holes);
  RUN(memory_that_runs_out_is_told_and_nothing_leaks);
}

CHECK_ALONE(promises_meshes)
