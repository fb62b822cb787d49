// SPDX-License-Identifier: MIT
// hello_game.c - a world, a step a frame: a crate falls and comes to rest; a character walks at a wall
// aslant, goes on along it, and pushes the crate. After each frame no two of the four bodies overlap.
#define NEURALSVCD_IMPLEMENTATION
#define NSVCD_NO_NETWORK
#include "../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../extras/neuralsvcd_world.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static nsvcd_world *world;

static void check(nsvcd_result result) {
  if (result) fprintf(stderr, "%s\n", nsvcd_result_string(result)), exit(1);
}

// Bodies are encoded once, and may be in the world many times. One that is `fixed` only others hit.
static size_t put(const nsvcd_body *shape, int fixed, float x, float y, float z) {
  nsvcd_world_body body;
  size_t id;
  memset(&body, 0, sizeof body);
  body.body = shape;
  body.fixed = fixed;
  body.pose.position[0] = x;
  body.pose.position[1] = y;
  body.pose.position[2] = z;
  body.pose.rotation[3] = 1;
  check(nsvcd_world_add(world, &body, &id));
  return id;
}

int main(void) {
  const float floor_half[3] = {10, 10, 0.5f};  // metres
  const float wall_half[3] = {10, 0.1f, 1};
  const float crate_half[3] = {0.3f, 0.3f, 0.3f};
  const float feet[3] = {0, 0, -0.6f};
  const float head[3] = {0, 0, 0.6f};
  const size_t size = nsvcd_world_size(16);
  const size_t workspace_size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(workspace_size);  // once per thread
  const nsvcd_body *ground, *wall, *crate, *walker;
  nsvcd_world_mover movers[2];
  nsvcd_step_options options;

  check(nsvcd_encode_box(floor_half, 0, NULL, &ground));  // or nsvcd_encode, of a mesh
  check(nsvcd_encode_box(wall_half, 0, NULL, &wall));
  check(nsvcd_encode_box(crate_half, 0, NULL, &crate));
  check(nsvcd_encode_capsule(feet, head, 0.3f, NULL, &walker));
  check(nsvcd_world_begin(malloc(size), size, 16, &world));
  put(ground, 1, 0, 0, -0.5f);
  put(wall, 1, 0, 2, 1);

  memset(movers, 0, sizeof movers);  // zero is the default of everything but `id`
  movers[0].id = put(crate, 0, 0.5f, 1.5f, 2);
  movers[0].how.clearance = 0.002f;  // it rests off the floor by once to twice that
  movers[0].how.mass = 20;
  movers[0].how.friction = 0.5f;
  for (int k = 0; k < 3; k++) movers[0].how.inertia[k] = 20 * 0.6f * 0.6f / 6;  // of a cube
  movers[1].id = put(walker, 0, -3, 0.5f, 1);
  movers[1].how.up[2] = 1;  // it stands upright, and has no mass: a character
  movers[1].how.step = 0.25f;
  movers[1].how.clearance = 0.002f;
  movers[1].push_mass = 70;
  memset(&options, 0, sizeof options);
  options.gravity[2] = -9.81f;

  for (int frame = 0; frame <= 180; frame++) {
    movers[1].velocity.linear[0] = 1.5f;  // as a player would say
    movers[1].velocity.linear[1] = 1;
    check(nsvcd_world_step(world, movers, 2, &options, 1.0f / 60, workspace, workspace_size, NULL));
    const float *box = movers[0].answer.pose.position;
    const float *at = movers[1].answer.pose.position;
    if (frame % 30 == 0)
      printf("%.1f s: crate at %5.2f %.2f %.3f%s, walker at %5.2f %.2f %.3f\n", frame / 60.0,
             box[0], box[1], box[2], movers[0].asleep ? ", asleep" : "", at[0], at[1], at[2]);
  }
  return 0;
}
