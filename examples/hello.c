// SPDX-License-Identifier: MIT
// hello.c - two meshes, one motion, one answer. It prints `hit, t = 0.60`. README shows the middle
// of this program.
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const nsvcd_body *load(const char *path) {
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, NULL);          // or nsvcd_stl_load
  if (!result) result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body);  // once per mesh
  if (result) fprintf(stderr, "%s: %s\n", path, nsvcd_result_string(result)), exit(1);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}

int main(void) {
  const nsvcd_body *mug = load("examples/assets/mug.obj");
  const nsvcd_body *rack = load("examples/assets/dish_rack.obj");
  const nsvcd_pose path[2] = {{{0, -0.4f, 0.3f}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(size);  // once per thread
  nsvcd_question question;
  nsvcd_answer answer;

  memset(&question, 0, sizeof question);  // zero is the default of everything but the bodies
  question.a.body = mug;
  question.a.poses = path;  // positions and quaternions, as many as you like, uniform in time
  question.a.count = 2;
  question.b.body = rack;          // no poses: it rests at the origin
  question.ask = NSVCD_ASK_FIRST;  // the first contact; the default, HIT, is yes or no
  const nsvcd_result result = nsvcd_sweep(&question, workspace, size, &answer);
  if (result) return fprintf(stderr, "%s\n", nsvcd_result_string(result)), 1;
  printf("%s, t = %.2f\n", nsvcd_verdict_string(answer.verdict), answer.time.high);
  return 0;
}
