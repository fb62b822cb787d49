// Problem files, as `svcd check` reads them: refused with a complaint, or questions that can be
// asked.
#define FUZZ_TARGET "problem"
#define FUZZ_TOKENS                                                                             \
  "nsvcd-problems 1\n", "mesh a a.obj\n", "mesh b b.obj\n", "problem p a 1 b 1 ",               \
      "0 0 0 0 0 0 1 ", "0 0 0 0 0 0 1\n", "1 0.01 2\n", "0 nan 1\n", "-1 nan 1 1\n", "0 0 0 ", \
      "0.6 0 0.8 0\n", "#", "\n", "\r\n", "\t", " ", "nan ", "inf ", "1e400 ", "-1e-320 ",      \
      "0x1p3 ", "65536\n", "65537\n", "4294967297\n", "99999999999999999999 ", "-1 ", "\v",     \
      "problem ", "mesh ", "1e38 ",
#include "main.h"

#include "scene.h"

// Complaints are counted, and written to a file that is no more read.
static FILE *complaints;
#undef stderr
#define stderr complaints
#define PROGRAM "problem"
#include "../../examples/scenery/problem_file.h"
#undef stderr  // with glibc and musl there is a variable behind it

enum { MOST_ASKED = 8 };

static const char *const path = FUZZ_TARGET ".input";

static void write_input(const uint8_t *data, size_t size) {
  FILE *file = fopen(path, "wb");
  if (!file || fwrite(data, 1, size, file) != size || fclose(file))
    exit(2);
}

static void check_problem(const problem_file *file, const problem *p) {
  nsvcd_question question = question_of_problem(file, p);
  nsvcd_answer answer;
  FUZZ_CHECK(p->moving < file->mesh_count && p->fixed < file->mesh_count);
  FUZZ_CHECK(p->count >= 1 && p->count <= NSVCD_MAX_POSES && p->fixed_count <= NSVCD_MAX_POSES);
  FUZZ_CHECK(p->first_pose + p->count + p->fixed_count <= file->pose_count);
  FUZZ_CHECK(p->moving_scale > 0 && p->fixed_scale > 0);
  question.a.body = scene_body(p->moving % 4);
  question.b.body = scene_body(4 * (p->fixed % 2));
  question.work = 300;
  scene_ask(&question, &answer);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  problem_file file;
  if (!complaints)
    complaints = fopen("/dev/null", "w");
  if (!complaints)
    exit(2);
  write_input(data, size);
  if (read_problems(path, &file)) {
    fuzz_taken++;
    for (size_t k = 0; k < file.problem_count && k < MOST_ASKED; k++)
      check_problem(&file, &file.problems[k]);
  }
  free_problems(&file);
  remove(path);
  return 0;
}
