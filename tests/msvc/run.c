// What cl's path through entry/processor.h answers: the self test, and a mug that hits a rack.
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

int _fltused = 1;  // of Microsoft's library, which is not there
int printf(const char *, ...);

static const nsvcd_body *load(const char *path) {
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  if (nsvcd_obj_load(path, NULL, &mesh, NULL)) return NULL;
  return nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body) ? NULL : body;
}

int main(void) {
  const nsvcd_pose path[2] = {{{0, -0.4f, 0.3f}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  nsvcd_answer answer;
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  question.a.body = load("examples/assets/mug.obj");
  question.a.poses = path;
  question.a.count = 2;
  question.b.body = load("examples/assets/dish_rack.obj");
  const char *said = nsvcd_result_string(nsvcd_self_test());
  if (nsvcd_sweep(&question, malloc(size), size, &answer)) return 1;
  printf("level %d, self test %s, %s, t = %.4f\n", (int)nsvcd__isa_at_hand(), said, nsvcd_verdict_string(answer.verdict),
         answer.time.high);
  return 0;
}
