// SPDX-License-Identifier: MIT
// plan.c - a gantry carries a mug from one side of a dish rack to the other, and hits nothing.
//
//   build/plan     ends with 0 if the way is certified free
//
// What is certified is that the motion through the poses of the last check, straight and slerped in
// between, keeps 1 mm of clearance. The gantry follows a spline, which deviates from that motion by
// answer.deviation. As long as this is less than 1 mm, the spline is clear too, as measured.
//
// There are two bodies, of which one moves. The program says how the joints place them, which of
// them can meet, where to start and where to end. nsvcd_plan finds the way.
#include <stdio.h>
#include <stdlib.h>

#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

enum { MUG, RACK, BODIES };
enum { JOINTS = 3 };  // the gantry slides along x, y and z
static const float clearance = 0.001f;

// Loads and encodes a mesh, once. Returns NULL, with a message, if the file is no mesh.
static const nsvcd_body *load(const char *path) {
  const nsvcd_encode_options options = {.latents = 1};  // a planner asks the network first
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  size_t line = 0;
  nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, &line);
  if (!result) {
    result = nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body);
    nsvcd_mesh_free(&mesh, NULL);
  }
  if (result) fprintf(stderr, "%s:%zu: %s\n", path, line, nsvcd_result_string(result));
  return body;
}

// Tells where all bodies are at these joints. What is held moves with the hand because this says
// so.
static void place(void *user, const float *joints, nsvcd_pose *poses) {
  const nsvcd_pose at_origin = {{0, 0, 0}, {0, 0, 0, 1}};
  (void)user;
  poses[RACK] = poses[MUG] = at_origin;
  for (int k = 0; k < JOINTS; k++) poses[MUG].position[k] = joints[k];
}

int main(void) {
  const nsvcd_body *const bodies[BODIES] = {load("examples/assets/mug.obj"),
                                            load("examples/assets/dish_rack.obj")};
  if (!bodies[MUG] || !bodies[RACK]) return 1;

  const float low[JOINTS] = {-1, -1, 0}, high[JOINTS] = {1, 1, 1};
  const float start[JOINTS] = {0, -0.5f, 0}, goal[JOINTS] = {0, 0.5f, 0};
  const nsvcd_body_pair pair = {MUG, RACK};
  nsvcd_plan_problem problem = {0};
  problem.joints = JOINTS;
  problem.low = low;
  problem.high = high;
  problem.start = start;
  problem.goal = goal;
  problem.bodies = bodies;
  problem.body_count = BODIES;
  problem.pairs = &pair;
  problem.pair_count = 1;
  problem.kinematics = place;

  nsvcd_plan_options options = {0};
  options.sweep.clearance = clearance;

  const size_t size = nsvcd_plan_workspace_size(&problem, &options);
  void *workspace = malloc(size);
  float control[(NSVCD_MAX_VIA_POINTS + 2) * JOINTS];
  nsvcd_plan_answer answer;
  const nsvcd_result result = nsvcd_plan(&problem, &options, workspace, size, control, &answer);
  if (result) {
    fprintf(stderr, "%s\n", nsvcd_result_string(result));
    return 1;
  }

  const int is_free = answer.status == NSVCD_PLAN_CONVERGED && answer.deviation < clearance;
  printf("%s: %s by %.1f mm, from which the spline strays %.3f mm\n",
         nsvcd_plan_status_string(answer.status), is_free ? "certified free" : "not free",
         1000 * (double)clearance, 1000 * (double)answer.deviation);
  for (size_t k = 0; k < answer.via_points + 2; k++)
    printf("%5.2f %5.2f %5.2f\n", (double)control[JOINTS * k], (double)control[JOINTS * k + 1],
           (double)control[JOINTS * k + 2]);

  free(workspace);
  nsvcd_body_free(bodies[MUG], NULL);
  nsvcd_body_free(bodies[RACK], NULL);
  return !is_free;
}
