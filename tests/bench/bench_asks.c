// bench_asks.c - what more than yes or no costs: first contacts, clearances, the least distance and
// skins, beside the plain question, on the problems of files. Each problem is asked in all ways in
// turn, and the shortest of some times counts, so that what else the machine does troubles all
// alike.
//
//   build/bench_asks FILE [CLEARANCE]    CLEARANCE, metres: of all questions of a file
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "bench_asks"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/status_of.h"
#include "meter.h"

#define RUNS 5

typedef struct way {
  const char *name;
  nsvcd_question options;  // a and b left out
  double *microseconds;
  size_t collide, undecided;
} way;

static void print_way(way *w, size_t count, double plain) {
  double sum = 0;
  for (size_t i = 0; i < count; i++) sum += w->microseconds[i];
  meter_sort(w->microseconds, count);
  printf(
      "  %-26s median %6.1f  mean %6.1f  99 %% %6.0f  worst %6.0f us;  x %.2f;  %4.1f %% collide, "
      "%zu undecided\n",
      w->name, w->microseconds[count / 2], sum / (double)count,
      w->microseconds[(size_t)(0.99 * (double)count)], w->microseconds[count - 1], sum / plain,
      100 * (double)w->collide / (double)count, w->undecided);
}

int main(int argc, char **argv) {
  way ways[8];
  problem_file file;
  if (argc < 2 || argc > 3 || !read_problems(argv[1], &file))
    return complain("FILE [CLEARANCE]"), USAGE;
  static const char *const names[8] = {
      "plain",           "first, to 0.1",    "first, to 0.01",         "first, to 0.001",
      "clearance +1 mm", "clearance +10 mm", "least distance to 1 mm", "skin of 1 mm"};
  const float clearance = argc > 2 ? (float)atof(argv[2]) : 0;
  memset(ways, 0, sizeof ways);
  for (int k = 0; k < 8; k++) {
    ways[k].name = names[k];
    ways[k].options.clearance = clearance;
    ways[k].microseconds = (double *)allocate(file.problem_count * sizeof(double));
  }
  for (int k = 1; k < 4; k++) ways[k].options.ask = NSVCD_ASK_FIRST;
  ways[1].options.to_time = 0.1f;
  ways[2].options.to_time = 0.01f;
  ways[3].options.to_time = 0.001f;
  ways[4].options.clearance += 0.001f;
  ways[5].options.clearance += 0.01f;
  ways[6].options.ask = NSVCD_ASK_DISTANCE;
  ways[6].options.to = 0.001f;
  ways[7].options.slop = 0.001f;

  const nsvcd_body **bodies = (const nsvcd_body **)allocate(file.mesh_count * sizeof *bodies);
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  const char *slash = strrchr(argv[1], '/');
  for (size_t i = 0; i < file.mesh_count; i++) {
    char path[4096];
    nsvcd_mesh mesh;
    const int folder = file.meshes[i].path[0] == '/' || !slash ? 0 : (int)(slash - argv[1]) + 1;
    snprintf(path, sizeof path, "%.*s%s", folder, argv[1], file.meshes[i].path);
    nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, NULL);
    if (!result) result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &bodies[i]);
    if (result) return complain("%s: %s", path, nsvcd_result_string(result)), REFUSED;
    nsvcd_mesh_free(&mesh, NULL);
  }
  double plain = 0;
  for (size_t i = 0; i < file.problem_count; i++) {
    const problem *p = &file.problems[i];
    nsvcd_question of_problem = question_of_problem(&file, p);
    of_problem.a.body = bodies[p->moving];
    of_problem.b.body = bodies[p->fixed];
    for (int run = 0; run < RUNS; run++) {
      for (int k = 0; k < 8; k++) {
        nsvcd_answer answer;
        double *least = &ways[k].microseconds[i];
        nsvcd_question question = ways[k].options;
        question.a = of_problem.a;
        question.b = of_problem.b;
        const double start = seconds();
        const nsvcd_result result =
            nsvcd_sweep(&question, workspace, nsvcd_sweep_workspace_size(NULL), &answer);
        const double taken = 1e6 * (seconds() - start);
        if (result) return complain("%s: %s", p->id, nsvcd_result_string(result)), REFUSED;
        *least = run == 0 ? taken : fmin(*least, taken);
        ways[k].collide += run == 0 && collides_of(&answer);
        ways[k].undecided += run == 0 && answer.verdict == NSVCD_UNDECIDED;
      }
    }
    plain += ways[0].microseconds[i];
  }
  printf("%s: %zu problems\n", argv[1], file.problem_count);
  for (int k = 0; k < 8; k++) {
    print_way(&ways[k], file.problem_count, plain);
    free(ways[k].microseconds);
  }
  for (size_t i = 0; i < file.mesh_count; i++) nsvcd_body_free(bodies[i], NULL);
  free(bodies);
  free(workspace);
  free_problems(&file);
  return DONE;
}
