// What the tests of the promises share: boxes, poses, and a question asked. They see the library as
// a program does that links it: its declarations alone.
#ifndef NSVCD_TESTS_PROMISES_SCENE_H
#define NSVCD_TESTS_PROMISES_SCENE_H

#include "../../neuralsvcd.h"
#include "../../extras/neuralsvcd_certify.h"
#include "../../extras/neuralsvcd_robot.h"
#include "../../extras/neuralsvcd_world.h"
#include "../check.h"

// The corners and the faces of a box about the origin; `faces` of them, the lid (z up) last.
#define BOX_CORNERS 8
#define BOX_FACES 6
#define OPEN_BOX_FACES 5
static const uint32_t box_faces[4 * BOX_FACES] = {0, 2, 3, 1, 0, 1, 5, 4, 1, 3, 7, 5,
                                                  3, 2, 6, 7, 2, 0, 4, 6, 4, 5, 7, 6};

static inline nsvcd_mesh box_mesh_of(float x, float y, float z, size_t faces) {
  static const uint32_t sizes[BOX_FACES] = {4, 4, 4, 4, 4, 4};
  float corners[3 * BOX_CORNERS];
  nsvcd_mesh mesh = {NULL, NULL, 0, 0};
  for (int i = 0; i < BOX_CORNERS; i++) {
    corners[3 * i] = i & 1 ? x / 2 : -x / 2;
    corners[3 * i + 1] = i & 2 ? y / 2 : -y / 2;
    corners[3 * i + 2] = i & 4 ? z / 2 : -z / 2;
  }
  const nsvcd_faces given = {corners, box_faces, sizes, BOX_CORNERS, 4 * faces, faces};
  CHECK_EQ(nsvcd_mesh_of_faces(&given, NULL, &mesh), NSVCD_OK);
  return mesh;
}
static inline nsvcd_mesh box_mesh(float x, float y, float z) {
  return box_mesh_of(x, y, z, BOX_FACES);
}

// One mesh of two, the second one so far above.
static inline nsvcd_mesh stacked(nsvcd_mesh a, nsvcd_mesh b, float above) {
  nsvcd_mesh both = {NULL, NULL, a.vertex_count + b.vertex_count,
                     a.triangle_count + b.triangle_count};
  both.positions = (float *)malloc(3 * both.vertex_count * sizeof(float));
  both.indices = (uint32_t *)malloc(3 * both.triangle_count * sizeof(uint32_t));
  memcpy(both.positions, a.positions, 3 * a.vertex_count * sizeof(float));
  memcpy(both.indices, a.indices, 3 * a.triangle_count * sizeof(uint32_t));
  for (size_t i = 0; i < 3 * b.vertex_count; i++)
    both.positions[3 * a.vertex_count + i] = b.positions[i] + (i % 3 == 2 ? above : 0);
  for (size_t i = 0; i < 3 * b.triangle_count; i++)
    both.indices[3 * a.triangle_count + i] = b.indices[i] + (uint32_t)a.vertex_count;
  nsvcd_mesh_free(&a, NULL);
  nsvcd_mesh_free(&b, NULL);
  return both;
}

// A flat sheet about the origin, of squares of 1 m, `side` by `side`; its middle is a tip so high.
static inline nsvcd_mesh sheet_mesh(size_t side, float tip) {
  const size_t corners = (side + 1) * (side + 1), squares = side * side;
  float *positions = (float *)malloc(3 * corners * sizeof(float));
  uint32_t *faces = (uint32_t *)malloc(4 * squares * sizeof(uint32_t));
  uint32_t *sizes = (uint32_t *)malloc(squares * sizeof(uint32_t));
  nsvcd_mesh mesh = {NULL, NULL, 0, 0};
  for (size_t i = 0; i < corners; i++) {
    const size_t x = i % (side + 1), y = i / (side + 1);
    positions[3 * i] = (float)x - (float)(side / 2);
    positions[3 * i + 1] = (float)y - (float)(side / 2);
    positions[3 * i + 2] = x == side / 2 && y == side / 2 ? tip : 0;
  }
  for (size_t f = 0; f < squares; f++) {
    const uint32_t low = (uint32_t)(f / side * (side + 1) + f % side), above = (uint32_t)side + 1;
    const uint32_t face[4] = {low, low + 1, low + above + 1, low + above};
    memcpy(faces + 4 * f, face, sizeof face);
    sizes[f] = 4;
  }
  const nsvcd_faces given = {positions, faces, sizes, corners, 4 * squares, squares};
  CHECK_EQ(nsvcd_mesh_of_faces(&given, NULL, &mesh), NSVCD_OK);
  free(positions);
  free(faces);
  free(sizes);
  return mesh;
}

// Of the quickstart; tests run in the repository's root.
static inline nsvcd_mesh mug_mesh(void) {
  nsvcd_mesh mesh = {NULL, NULL, 0, 0};
  CHECK_EQ(nsvcd_obj_load("examples/assets/mug.obj", NULL, &mesh, NULL), NSVCD_OK);
  return mesh;
}

static inline const nsvcd_body *body_of(nsvcd_mesh mesh, const nsvcd_encode_options *options) {
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, options, NULL, NULL, 0, &body), NSVCD_OK);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}
static inline const nsvcd_body *box(float x, float y, float z) {
  return body_of(box_mesh(x, y, z), NULL);
}

static inline nsvcd_pose at(float x, float y, float z) {
  const nsvcd_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  return pose;
}
// Turned about z, radians.
static inline nsvcd_pose turned(float x, float y, float z, float angle) {
  const nsvcd_pose pose = {{x, y, z}, {0, 0, sinf(angle / 2), cosf(angle / 2)}};
  return pose;
}

// A moves along its poses, and b rests at the origin.
static inline nsvcd_question question_about(const nsvcd_body *a, const nsvcd_pose *poses,
                                            size_t count, const nsvcd_body *b) {
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  question.a.body = a;
  question.a.poses = poses;
  question.a.count = count;
  question.b.body = b;
  return question;
}

static inline nsvcd_answer answer_to(const nsvcd_question *question) {
  const size_t size = nsvcd_sweep_workspace_size(question);
  void *workspace = malloc(size);
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK(size > 0);
  CHECK_EQ(nsvcd_sweep(question, workspace, size, &answer), NSVCD_OK);
  free(workspace);
  return answer;
}
static inline nsvcd_verdict verdict_of(const nsvcd_question *question) {
  return answer_to(question).verdict;
}

#endif  // NSVCD_TESTS_PROMISES_SCENE_H
