// What the tests of the public API share: memory, meshes, bodies, and a problem with two random
// solids. Include after neuralsvcd.h with its implementation.
#ifndef QUERY_SCENE_H
#define QUERY_SCENE_H

#include "arrays.h"
#include "mesh_of.h"
#include "question_of.h"
#include "check.h"
#include "../examples/scenery/status_of.h"

#include <stdlib.h>

// Bodies for the network alone.
static const nsvcd_encode_options query_latents = {.no_triangles = 1};
static const nsvcd_encode_options query_both = {.latents = 1};

#define QUERY_ALIGN NSVCD_ALIGNMENT
#define QUERY_POSES 17
#define QUERY_POINTS 64  // of the bodies of a scene

// Memory with the library's alignment, whatever malloc's is; it lives until the process ends or
// query_release.
typedef struct query_memory {
  void *block, *at;
} query_memory;

static query_memory query_reserve(size_t size) {
  query_memory m;
  m.block = malloc(size + QUERY_ALIGN);
  if (!m.block) exit(1);
  m.at = (void *)(((uintptr_t)m.block + QUERY_ALIGN - 1) & ~(uintptr_t)(QUERY_ALIGN - 1));
  memset(m.at, 0x5a, size);  // so that whatever the library leaves unwritten differs from zero
  return m;
}
static void query_release(query_memory *m) {
  free(m->block);
  m->block = m->at = NULL;
}

static void *query_workspace(void) {  // one for all tests: they run one after the other
  static query_memory memory;
  if (!memory.block) memory = query_reserve(nsvcd_sweep_workspace_size(NULL));
  return memory.at;
}

static nsvcd_mesh query_solid(uint64_t seed, double extent) {
  shapes_rng rng = {seed};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_random_solid(&shape, &rng, extent);
  nsvcd_mesh mesh = mesh_of(&shape);
  shapes_free(&shape);
  return mesh;
}
static nsvcd_mesh query_box(double x, double y, double z) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, x, y, z, 2);
  nsvcd_mesh mesh = mesh_of(&shape);
  shapes_free(&shape);
  return mesh;
}

// Encodes with `points` (0: default) into fresh memory.
static const nsvcd_body *query_encode(const nsvcd_mesh *mesh, size_t points, query_memory *memory) {
  nsvcd_encode_options options = {.patches = points, .no_triangles = 1};
  size_t size = nsvcd_body_size(points ? points : NSVCD_DEFAULT_NETWORK_PATCHES);
  const nsvcd_body *body = NULL;
  *memory = query_reserve(size);
  CHECK_EQ(nsvcd_encode(mesh, &options, NULL, memory->at, size, &body), NSVCD_OK);
  return body;
}
static nsvcd_answer query_answer(const nsvcd_question *question) {
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_sweep(question, query_workspace(), nsvcd_sweep_workspace_size(NULL), &answer),
           NSVCD_OK);
  return answer;
}
static nsvcd_answer query_ask(const nsvcd_body *moving, const nsvcd_pose *poses, size_t count,
                              const nsvcd_body *fixed, const nsvcd_pose *fixed_pose,
                              const nsvcd_question *asked) {
  const nsvcd_question question = question_of(moving, poses, count, fixed, fixed_pose, asked);
  return query_answer(&question);
}

static nsvcd_pose query_pose(double x, double y, double z) {
  nsvcd_pose pose = {{(float)x, (float)y, (float)z}, {0, 0, 0, 1}};
  return pose;
}
static void query_random_pose(shapes_rng *rng, double reach, nsvcd_pose *pose) {
  double q[4];
  shapes_quaternion(rng, q);
  for (int k = 0; k < 3; k++) pose->position[k] = (float)shapes_uniform(rng, -reach, reach);
  for (int k = 0; k < 4; k++) pose->rotation[k] = (float)q[k];
}
// out = r a for quaternions x y z w.
static void query_multiply(const float *r, const float *a, float *out) {
  float x = r[3] * a[0] + r[0] * a[3] + r[1] * a[2] - r[2] * a[1];
  float y = r[3] * a[1] - r[0] * a[2] + r[1] * a[3] + r[2] * a[0];
  float z = r[3] * a[2] + r[0] * a[1] - r[1] * a[0] + r[2] * a[3];
  out[3] = r[3] * a[3] - r[0] * a[0] - r[1] * a[1] - r[2] * a[2];
  out[0] = x;
  out[1] = y;
  out[2] = z;
}
// The same pose after everything was moved by `common`.
static nsvcd_pose query_moved(const nsvcd_pose *common, const nsvcd_pose *pose) {
  nsvcd_pose out;
  float m[9];
  matrix_of_quat(common->rotation, m);
  mul33_vec(m, pose->position, out.position);
  for (int k = 0; k < 3; k++) out.position[k] += common->position[k];
  query_multiply(common->rotation, pose->rotation, out.rotation);
  return out;
}

static nsvcd_question query_options(size_t pairs, nsvcd_model model, float recall) {
  nsvcd_question options;
  memset(&options, 0, sizeof options);
  options.network.pairs = pairs;
  options.network.model = model;
  options.network.recall = recall;
  return options;
}

// A problem with two random solids that come close: a straight path past the fixed body's centre,
// turning half around.
typedef struct query_scene {
  query_memory memory[2];
  const nsvcd_body *moving, *fixed;
  nsvcd_pose motion[QUERY_POSES], fixed_pose;
} query_scene;

static void query_scene_motion(query_scene *s, shapes_rng *rng) {
  double start[3], end[3], axis[3];
  nsvcd_pose turn;
  shapes_direction(rng, start);
  shapes_direction(rng, end);
  shapes_direction(rng, axis);
  query_random_pose(rng, 0.1, &s->fixed_pose);
  query_random_pose(rng, 0, &turn);
  for (int i = 0; i < QUERY_POSES; i++) {
    double t = (double)i / (QUERY_POSES - 1);
    double angle = 1.5 * t;
    float step[4] = {(float)(axis[0] * sin(angle)), (float)(axis[1] * sin(angle)),
                     (float)(axis[2] * sin(angle)), (float)cos(angle)};
    for (int k = 0; k < 3; k++)
      s->motion[i].position[k] = s->fixed_pose.position[k] +
                                 (float)(0.25 * start[k] + t * (0.25 * end[k] - 0.25 * start[k]));
    query_multiply(step, turn.rotation, s->motion[i].rotation);
  }
}
static void query_scene_open(query_scene *s, uint64_t seed) {
  shapes_rng rng = {seed};
  nsvcd_mesh moving = query_solid(2 * seed, 0.2);
  nsvcd_mesh fixed = query_solid(2 * seed + 1, 0.3);
  s->moving = query_encode(&moving, QUERY_POINTS, &s->memory[0]);
  s->fixed = query_encode(&fixed, QUERY_POINTS, &s->memory[1]);
  nsvcd_mesh_free(&moving, NULL);
  nsvcd_mesh_free(&fixed, NULL);
  query_scene_motion(s, &rng);
}
static void query_scene_close(query_scene *s) {
  query_release(&s->memory[0]);
  query_release(&s->memory[1]);
}

static nsvcd_answer query_scene_ask(const query_scene *s) {
  return query_ask(s->moving, s->motion, QUERY_POSES, s->fixed, &s->fixed_pose, NULL);
}
static int query_same_answer(const nsvcd_answer *a, const nsvcd_answer *b) {  // to the bit
  const nsvcd_opinion *x = &a->opinion;
  const nsvcd_opinion *y = &b->opinion;
  return a->verdict == b->verdict && a->by == b->by && a->inside == b->inside &&
         memcmp(&a->time, &b->time, sizeof a->time) == 0 && x->asked == y->asked &&
         memcmp(&x->logit, &y->logit, sizeof x->logit) == 0 &&
         memcmp(&x->distance, &y->distance, sizeof x->distance) == 0 &&
         memcmp(&x->time, &y->time, sizeof x->time) == 0 && x->patch_a == y->patch_a &&
         x->patch_b == y->patch_b && x->candidates == y->candidates && x->limited == y->limited;
}
// The same, and all that only a proof says.
static int query_same_proof(const nsvcd_answer *a, const nsvcd_answer *b) {
  return query_same_answer(a, b) && a->work == b->work && a->why == b->why &&
         a->contact_count == b->contact_count &&
         memcmp(&a->nearest, &b->nearest, sizeof a->nearest) == 0 &&
         memcmp(&a->distance, &b->distance, sizeof a->distance) == 0 &&
         memcmp(&a->safe, &b->safe, sizeof a->safe) == 0 &&
         memcmp(a->push_out, b->push_out, sizeof a->push_out) == 0;
}

#endif
