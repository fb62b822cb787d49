// props.h - meshes as movers of an nsvcd_world, for the examples. Include neuralsvcd.h and
// extras/neuralsvcd_world.h first. No part of the library.
#ifndef NSVCD_SCENERY_PROPS_H
#define NSVCD_SCENERY_PROPS_H

#include "shapes.h"

#define PROPS_WORK 2000  // units a question: what takes more is stopped early

typedef struct props_shape {
  const nsvcd_body *body;
  nsvcd_mass mass;
} props_shape;

SHAPES_DEF nsvcd_result props_encode(const shapes_mesh *mesh, float patch_radius,
                                     props_shape *shape) {
  nsvcd_encode_options options;
  nsvcd_mesh given;
  memset(&options, 0, sizeof options);
  memset(&given, 0, sizeof given);
  options.patch_radius = patch_radius;
  given.positions = (float *)malloc((3 * mesh->vertices + 1) * sizeof(float));
  given.indices = mesh->indices;
  given.vertex_count = mesh->vertices;
  given.triangle_count = mesh->triangles;
  nsvcd_result result = given.positions && !mesh->failed ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  for (size_t i = 0; i < 3 * mesh->vertices && !result; i++)
    given.positions[i] = (float)mesh->positions[i];
  if (!result) result = nsvcd_encode(&given, &options, NULL, NULL, 0, &shape->body);
  if (!result) result = nsvcd_mesh_mass(&given, &shape->mass);
  free(given.positions);
  return result;
}

// Is the mover of this body where nothing is, by its clearance?
SHAPES_DEF int props_is_free(const nsvcd_world *world, const nsvcd_world_mover *m, void *workspace,
                             size_t size) {
  nsvcd_world_question question;
  nsvcd_world_answer answer;
  memset(&question, 0, sizeof question);
  question.self = m->id;
  question.question.clearance = m->how.clearance;
  return !nsvcd_world_sweep(world, &question, workspace, size, &answer) &&
         answer.verdict == NSVCD_FREE;
}

// Moves a pose so that a point of the body is where its origin was.
SHAPES_DEF void props_centre(const float *point, float scale, nsvcd_pose *pose) {
  const float *q = pose->rotation;
  float across[3];
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    across[k] = 2 * (q[i] * point[j] - q[j] * point[i]);
  }
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    pose->position[k] -=
        scale * (point[k] + q[3] * across[k] + q[i] * across[j] - q[j] * across[i]);
  }
}

// A body of a shape, with its centre of mass at the pose. Without a mass it is fixed, with its origin
// there.
SHAPES_DEF size_t props_add(nsvcd_world *world, const props_shape *shape, float scale, float mass,
                            const nsvcd_pose *pose) {
  nsvcd_world_body body;
  size_t id = NSVCD_NOBODY;
  memset(&body, 0, sizeof body);
  body.body = shape->body;
  body.pose = *pose;
  body.scale = scale;
  body.fixed = !(mass > 0);
  if (mass > 0) props_centre(shape->mass.centre, scale, &body.pose);
  memcpy(body.pivot, shape->mass.centre, sizeof body.pivot);
  return nsvcd_world_add(world, &body, &id) ? NSVCD_NOBODY : id;
}

// Moves it: `gap` metres is what it never comes nearer to anything than.
SHAPES_DEF nsvcd_world_mover props_mover(size_t id, const props_shape *shape, float scale,
                                         float mass, float gap) {
  const float *inertia = shape->mass.inertia;
  nsvcd_world_mover out;
  memset(&out, 0, sizeof out);
  out.id = id;
  out.how.clearance = gap;
  out.how.margin = 0.5f * gap;
  out.how.mass = mass;
  out.how.friction = 0.5f;
  out.how.restitution = 0.3f;
  out.how.work = PROPS_WORK;
  // slivers spin too wildly: none is thinner than that
  const float least = 0.02f * (inertia[0] + inertia[1] + inertia[2]);
  for (int k = 0; k < 3; k++)
    out.how.inertia[k] = mass * scale * scale * (inertia[k] > least ? inertia[k] : least);
  return out;
}

// A character: upright, with a mass that it pushes with, and as high a step as it climbs.
SHAPES_DEF nsvcd_world_mover props_character(size_t id, float push_mass, float step) {
  nsvcd_world_mover out;
  memset(&out, 0, sizeof out);
  out.id = id;
  out.push_mass = push_mass;
  out.how.up[2] = 1;
  out.how.step = step;
  return out;
}

#endif
