// SPDX-License-Identifier: MIT
// quickstart.c - a mug is carried into a dish rack, once too low and once high enough. Which of the
// two motions hits, and when first?
//
// It loads two OBJ files, encodes two bodies, asks about two motions, and draws the answers (`make
// demo`: build/demo.svg). `build/quickstart build/demo.gif` writes a film of them as well.
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "picture.h"
#include "film.h"
#include "scenery/clock.h"

#define POSES 65  // poses of a motion

// Loads a mesh and encodes it. Returns NULL, with a message, if that fails.
static const nsvcd_body *load(const char *path, nsvcd_mesh *mesh) {
  size_t line = 0;
  const nsvcd_body *body = NULL;
  nsvcd_result result = nsvcd_obj_load(path, NULL, mesh, &line);
  double start = seconds();
  if (!result) result = nsvcd_encode(mesh, NULL, NULL, NULL, 0, &body);
  if (result) return fprintf(stderr, "%s:%zu: %s\n", path, line, nsvcd_result_string(result)), NULL;
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  printf("%-29s %zu triangles -> %zu patches, %zu bytes, in %.1f ms\n", path, mesh->triangle_count,
         facts.patches, facts.size, 1e3 * (seconds() - start));
  return body;
}

// Makes the poses of a cubic Bezier curve through the air, `height` metres high. The mug, at first
// tilted, comes upright on the way.
static void carry(float height, nsvcd_pose *poses) {
  const float control[4][3] = {
      {0.04f, -0.46f, 0.03f}, {0, -0.36f, height}, {0, -0.01f, height}, {0, 0, 0.02f}};
  for (size_t i = 0; i < POSES; i++) {
    float t = (float)i / (POSES - 1);
    float s = 1 - t;
    float yaw = -1.5708f + 0.5f * s;
    float tilt = 0.9f * s * s;
    float weights[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    for (size_t k = 0; k < 3; k++) {
      poses[i].position[k] = 0;
      for (size_t c = 0; c < 4; c++) poses[i].position[k] += weights[c] * control[c][k];
    }
    float cy = cosf(yaw / 2);
    float sy = sinf(yaw / 2);
    float ct = cosf(tilt / 2);
    float st = sinf(tilt / 2);
    poses[i].rotation[0] = st * cy;
    poses[i].rotation[1] = -st * sy;  // about z by yaw, then about x by tilt
    poses[i].rotation[2] = ct * sy;
    poses[i].rotation[3] = ct * cy;
  }
}

int main(int argc, char **argv) {
  // Once per mesh: load and encode. A body is one block of bytes: keep it, save it, copy it.
  nsvcd_mesh mug_mesh, rack_mesh;
  const nsvcd_body *mug = load("examples/assets/mug.obj", &mug_mesh);
  const nsvcd_body *rack = load("examples/assets/dish_rack.obj", &rack_mesh);
  if (!mug || !rack) return 1;

  // Once per thread: memory to work in. Queries allocate nothing.
  size_t workspace_size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(workspace_size);

  const char *const names[2] = {"carried low", "carried high"};
  const float heights[2] = {0.15f, 0.36f};
  picture_panel panels[2];
  for (int i = 0; i < 2; i++) {
    nsvcd_pose motion[POSES];
    nsvcd_answer answer;
    carry(heights[i], motion);

    // Once per question: zero is the default of everything but the bodies, and so the rack rests at
    // the origin.
    nsvcd_question question = {0};
    question.a.body = mug;
    question.a.poses = motion;
    question.a.count = POSES;
    question.b.body = rack;
    question.ask = NSVCD_ASK_FIRST;  // HIT, the default, tells of any contact, not of the first
    nsvcd_result result = NSVCD_OK;
    double least = HUGE_VAL;
    for (int run = 0; run < 20 && !result; run++) {  // many times only to time it
      double start = seconds();
      result = nsvcd_sweep(&question, workspace, workspace_size, &answer);
      least = fmin(least, 1e6 * (seconds() - start));
    }
    if (result) return fprintf(stderr, "%s\n", nsvcd_result_string(result)), 1;

    // What the answer says is proven: two triangles that meet are the witness of a hit.
    const char *const says[3] = {"may hit", "clears", "HITS"};  // a word for each verdict
    const char *const proofs[3] = {"undecided", "certified-free", "witness"};
    printf("%-12s -> %s (%s; %.0f us)", names[i], says[answer.verdict],
           answer.inside ? "inside" : proofs[answer.verdict], least);
    if (answer.verdict == NSVCD_HIT) {
      const float *p = answer.nearest.point;
      const float *n = answer.nearest.normal;
      printf(" first at t = %.2f, (%.3f, %.3f, %.3f), normal (%.2f, %.2f, %.2f)",
             (double)answer.time.high, (double)p[0], (double)p[1], (double)p[2], (double)n[0],
             (double)n[1], (double)n[2]);
    }
    printf("\n");
    picture_take(&panels[i], names[i], motion, POSES, &answer, least);
  }
  if (!picture_write("build/demo.svg", &mug_mesh, &rack_mesh, panels, 2)) return 1;
  printf("see build/demo.svg\n");
  if (argc > 1 && !film_write(argv[1], &mug_mesh, &rack_mesh, panels, 2)) return 1;

  free(workspace);
  nsvcd_body_free(mug, NULL);
  nsvcd_body_free(rack, NULL);
  nsvcd_mesh_free(&mug_mesh, NULL);
  nsvcd_mesh_free(&rack_mesh, NULL);
  return 0;
}
