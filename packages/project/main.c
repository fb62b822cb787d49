// SPDX-License-Identifier: MIT
// A mug falls on another: a program for any build system. The build says whether this file holds
// the implementation (NEURALSVCD_IMPLEMENTATION) or a library does.
//   falling_mug MESH.obj
#include <neuralsvcd.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
  nsvcd_mesh mesh;
  const nsvcd_body *mug = NULL;
  nsvcd_result result = NSVCD_ERROR_ARGUMENT;
  if (argc == 2) result = nsvcd_obj_load(argv[1], NULL, &mesh, NULL);
  if (!result) result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &mug);

  const nsvcd_pose fall[2] = {{{0, 0, 0.5f}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  question.a.body = mug;
  question.a.poses = fall;
  question.a.count = 2;
  question.b.body = mug;
  question.ask = NSVCD_ASK_FIRST;
  question.to_time = 0.01f;

  nsvcd_answer answer;
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(size);
  if (!result) result = nsvcd_sweep(&question, workspace, size, &answer);
  if (result) {
    fprintf(stderr, "%s\n", nsvcd_result_string(result));
    return 1;
  }
  if (answer.verdict == NSVCD_HIT)
    printf("hits at %.2f\n", (double)answer.time.high);
  else
    printf("%s\n", nsvcd_verdict_string(answer.verdict));
  free(workspace);
  nsvcd_body_free(mug, NULL);
  nsvcd_mesh_free(&mesh, NULL);
  return 0;
}
