// world_scene.h - a world of boxes and other shapes, and how far apart its bodies are, by the oracle in
// double. After the implementation of the library and of extras/neuralsvcd_world.h.
#ifndef NSVCD_TESTS_WORLD_SCENE_H
#define NSVCD_TESTS_WORLD_SCENE_H

#include "../examples/scenery/level.h"
#include "../examples/scenery/oracle.h"
#include "body_of.h"
#include "check.h"
#include "random_numbers.h"

enum { STAGE_MOST = 40 };

// A body, and its mesh as the oracle has it.
typedef struct thing {
  const nsvcd_body *body;
  oracle_mesh mesh;
} thing;

// Takes the shape.
static thing thing_of(shapes_mesh *shape) {
  thing out;
  memset(&out, 0, sizeof out);
  out.body = body_of(shape, NULL);
  for (size_t k = 0; k < 3 * shape->vertices; k++)
    shape->positions[k] = (double)(float)shape->positions[k];
  if (!oracle_mesh_init(&out.mesh, shape->positions, shape->vertices, shape->indices,
                        shape->triangles, 1))
    exit(1);
  shapes_free(shape);
  return out;
}
// By its whole lengths.
static thing thing_box(double x, double y, double z) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, x, y, z, 1);
  return thing_of(&shape);
}
static void thing_free(thing *t) {
  nsvcd_body_free(t->body, NULL);
  oracle_mesh_free(&t->mesh);
}

static nsvcd_pose pose_of(double x, double y, double z) {
  const nsvcd_pose out = {{(float)x, (float)y, (float)z}, {0, 0, 0, 1}};
  return out;
}
// Turned about an axis, x y or z.
static nsvcd_pose turned(double x, double y, double z, int axis, double angle) {
  nsvcd_pose out = pose_of(x, y, z);
  out.rotation[axis] = (float)sin(angle / 2);
  out.rotation[3] = (float)cos(angle / 2);
  return out;
}
static oracle_pose seen(const nsvcd_pose *pose) {
  oracle_pose out = {{0, 0, 0}, {0, 0, 0, 1}};
  for (int k = 0; k < 3; k++) out.position[k] = (double)pose->position[k];
  for (int k = 0; k < 4; k++) out.rotation[k] = (double)pose->rotation[k];
  oracle_quat_normalize(out.rotation);
  return out;
}

// How far apart two things are, below 0 if they meet or one is inside the other.
static double apart(const thing *a, const oracle_pose *at_a, const thing *b,
                    const oracle_pose *at_b) {
  const double d = oracle_distance(&a->mesh, at_a, &b->mesh, at_b, NULL, NULL);
  if (!(d > 0)) return -1;
  if (oracle_inside(&a->mesh, at_a, &b->mesh, at_b) > 0.5) return -1;
  if (oracle_inside(&b->mesh, at_b, &a->mesh, at_a) > 0.5) return -1;
  return d;
}

static void *workspace(size_t *size) {
  static void *memory;
  *size = nsvcd_sweep_workspace_size(NULL);
  if (!memory) memory = malloc(*size);
  if (!memory) exit(1);
  memset(memory, 0x5a, 256);
  return memory;
}

// A world, and the things in it by their ids.
typedef struct stage {
  void *memory;
  nsvcd_world *world;
  thing things[STAGE_MOST + 1];
  size_t count;
} stage;

static stage stage_begin(void) {
  stage out;
  memset(&out, 0, sizeof out);
  const size_t size = nsvcd_world_size(STAGE_MOST);
  out.memory = malloc(size);
  if (!out.memory) exit(1);
  memset(out.memory, 0x5a, size);
  CHECK_EQ(nsvcd_world_begin(out.memory, size, STAGE_MOST, &out.world), NSVCD_OK);
  return out;
}
// Takes the thing.
static size_t stage_add_body(stage *s, thing t, nsvcd_world_body body) {
  size_t id = 0;
  body.body = t.body;
  CHECK_EQ(nsvcd_world_add(s->world, &body, &id), NSVCD_OK);
  s->things[id] = t;
  if (id > s->count) s->count = id;
  return id;
}
static size_t stage_add(stage *s, thing t, nsvcd_pose pose, int fixed) {
  nsvcd_world_body body;
  memset(&body, 0, sizeof body);
  body.pose = pose;
  body.fixed = fixed;
  return stage_add_body(s, t, body);
}
static void stage_remove(stage *s, size_t id) {
  CHECK_EQ(nsvcd_world_remove(s->world, id), NSVCD_OK);
  thing_free(&s->things[id]);
  memset(&s->things[id], 0, sizeof s->things[id]);
}
static void stage_end(stage *s) {
  for (size_t id = 1; id <= s->count; id++)
    if (s->things[id].body) thing_free(&s->things[id]);
  free(s->memory);
}
static nsvcd_pose stage_pose(const stage *s, size_t id) {
  nsvcd_world_body body;
  memset(&body, 0, sizeof body);
  CHECK_EQ(nsvcd_world_get(s->world, id, &body), NSVCD_OK);
  return body.pose;
}
// The least distance of a body, at a pose, from all others, which are where the world has them.
static double stage_apart_at(const stage *s, size_t id, const nsvcd_pose *pose) {
  double least = HUGE_VAL;
  const oracle_pose at = seen(pose);
  for (size_t n = 1; n <= s->count; n++) {
    if (n == id || !s->things[n].body) continue;
    const nsvcd_pose other = stage_pose(s, n);
    const oracle_pose there = seen(&other);
    least = fmin(least, apart(&s->things[id], &at, &s->things[n], &there));
  }
  return least;
}
static double stage_apart(const stage *s, size_t id) {
  const nsvcd_pose pose = stage_pose(s, id);
  return stage_apart_at(s, id, &pose);
}

#endif
