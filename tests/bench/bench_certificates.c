// bench_certificates.c - certificates of the problems of files (examples/FORMATS.md): made, checked
// by examples/verify, compared with what nsvcd_sweep says. A table: bytes, visits, milliseconds.
//   build/bench_certificates [--clearance METRES] [--own] FILE...
// --own: nsvcd_sweep is not told, so that it is a second opinion on hits as well.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../../extras/neuralsvcd_certify.h"
#include "../../extras/neuralsvcd_robot.h"

#define PROGRAM "bench_certificates"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/verify/nsvcd_verify.h"
#include "../../examples/scenery/load.h"
#include "meter.h"

#define ROOM ((size_t)1 << 22)

typedef struct scene_mesh {
  nsvcd_mesh mesh;
  const nsvcd_body *body;
  const nsvcd_tree *tree;
  nsvcd_verify_mesh checked;
} scene_mesh;

typedef struct tally {
  double *bytes, *visits, *making, *checking;  // of what is free, and certified
  double worst;                                // milliseconds of a hit
  size_t free, certified, hits, shown, touch, disagree, refused;
  double trees, check_trees;
} tally;

static void row(const char *what, double *numbers, size_t count) {
  double sum = 0;
  if (count == 0) return;
  meter_sort(numbers, count);
  for (size_t i = 0; i < count; i++) sum += numbers[i];
  printf("  %-22s %10.4g %10.4g %10.4g %10.4g\n", what, numbers[count / 2], sum / (double)count,
         numbers[count * 9 / 10], numbers[count - 1]);
}

static int load(const problem_file *file, const mesh_entry *entry, scene_mesh *out, tally *t) {
  char path[4096];
  path_of(file->path, entry->path, path, sizeof path);
  if (!load_mesh(file->path, path, &out->mesh)) return 0;
  if (nsvcd_encode(&out->mesh, NULL, NULL, NULL, 0, &out->body)) return 0;
  const size_t size = nsvcd_tree_size(&out->mesh);
  double before = seconds();
  if (nsvcd_tree_build(&out->mesh, allocate(size), size, &out->tree)) return 0;
  t->trees += seconds() - before;
  before = seconds();
  const nsvcd_mesh *m = &out->mesh;
  void *memory = allocate(NSVCD_VERIFY_MESH_BYTES(m->vertex_count, m->triangle_count));
  const char *why = nsvcd_verify_mesh_init(m->positions, m->vertex_count, m->indices,
                                           m->triangle_count, memory, &out->checked);
  t->check_trees += seconds() - before;
  return why ? complain("%s: %s", path, why) : 1;
}

static const char *mover_of(const nsvcd_mover *from, const scene_mesh *mesh,
                            nsvcd_verify_path *path, nsvcd_verify_mover *mover) {
  path->poses = from->poses->position;
  path->times = from->times;
  path->count = from->count;
  return nsvcd_verify_path_init(&mesh->checked, from->scale, path, mover);
}

// The least of three.
static double time_of(double *best, double taken) {
  if (taken < *best) *best = taken;
  return *best;
}

static int one(const problem_file *file, const problem *p, const scene_mesh *meshes,
               float clearance, int own, uint8_t *bytes, tally *t) {
  nsvcd_question q = question_of_problem(file, p);
  const scene_mesh *a = &meshes[p->moving];
  const scene_mesh *b = &meshes[p->fixed];
  nsvcd_answer answer;
  nsvcd_certificate made;
  nsvcd_certify_options options = {own ? NULL : &answer, 0};
  q.a.body = a->body;
  q.b.body = b->body;
  q.clearance = clearance;
  const size_t sweep_size = nsvcd_sweep_workspace_size(&q);
  void *workspace = allocate(sweep_size);
  nsvcd_result result = nsvcd_sweep(&q, workspace, sweep_size, &answer);
  free(workspace);
  const size_t size = nsvcd_certify_workspace_size(&q, a->tree, b->tree);
  workspace = allocate(size);
  double making = 1e9, checking = 1e9;
  for (int k = 0; k < 3 && !result; k++) {
    const double before = seconds();
    result = nsvcd_certify(&q, a->tree, b->tree, &options, workspace, size, bytes, ROOM, &made);
    time_of(&making, 1e3 * (seconds() - before));
  }
  free(workspace);
  if (result) return complain("problem %s: %s", p->id, nsvcd_result_string(result));
  t->free += answer.verdict == NSVCD_FREE;
  t->hits += answer.verdict == NSVCD_HIT;
  if (made.verdict == NSVCD_UNDECIDED)
    return fprintf(stderr, "%s: %s, not certified after %zu visits, %.1f ms\n", p->id,
                   nsvcd_verdict_string(answer.verdict), made.visits, making),
           1;
  // a HIT of nsvcd_sweep is one to within both quanta
  nsvcd_certificate beyond = made;
  if (made.verdict == NSVCD_FREE && answer.verdict == NSVCD_HIT) {
    nsvcd_question wider = q;
    wider.clearance += 2 * (nsvcd_body_describe(a->body).quantization_error * q.a.scale +
                            nsvcd_body_describe(b->body).quantization_error * q.b.scale);
    workspace = allocate(size);
    result = nsvcd_certify(&wider, a->tree, b->tree, &options, workspace, size, NULL, 0, &beyond);
    free(workspace);
    t->touch += beyond.verdict != NSVCD_FREE;
  }
  if (beyond.verdict == made.verdict && made.verdict != answer.verdict &&
      answer.verdict != NSVCD_UNDECIDED) {
    t->disagree++;
    fprintf(stderr, "%s: nsvcd_sweep says %s, nsvcd_certify %s\n", p->id,
            nsvcd_verdict_string(answer.verdict), nsvcd_verdict_string(made.verdict));
  }
  nsvcd_verify_path path_a, path_b;
  nsvcd_verify_mover mover_a, mover_b;
  nsvcd_verify_report report;
  const size_t room = NSVCD_VERIFY_WORKSPACE_BYTES(q.a.count + q.b.count + 2);
  workspace = allocate(room);
  const char *why = mover_of(&q.a, a, &path_a, &mover_a);
  if (!why) why = mover_of(&q.b, b, &path_b, &mover_b);
  int accepted = !why;
  for (int k = 0; k < 3 && accepted; k++) {
    const double before = seconds();
    accepted =
        nsvcd_verify(&mover_a, &mover_b, clearance, bytes, made.size, workspace, room, &report);
    time_of(&checking, 1e3 * (seconds() - before));
    why = report.reason;
  }
  free(workspace);
  if (!accepted) {
    t->refused++;
    fprintf(stderr, "%s: refused: %s, byte %zu of %zu\n", p->id, why, report.position, made.size);
    return 1;
  }
  if (made.verdict == NSVCD_HIT) {
    t->shown++;
    if (making > t->worst) t->worst = making;
    return 1;
  }
  t->bytes[t->certified] = (double)made.size;
  t->visits[t->certified] = (double)made.visits;
  t->making[t->certified] = making;
  t->checking[t->certified++] = checking;
  return 1;
}

static int bench(const char *path, float clearance, int own) {
  problem_file file;
  tally t;
  memset(&t, 0, sizeof t);
  if (!read_problems(path, &file)) return 0;
  scene_mesh *meshes = (scene_mesh *)allocate(file.mesh_count * sizeof *meshes);
  double *numbers = (double *)allocate(4 * file.problem_count * sizeof(double));
  uint8_t *bytes = (uint8_t *)allocate(ROOM);
  t.bytes = numbers;
  t.visits = numbers + file.problem_count;
  t.making = numbers + 2 * file.problem_count;
  t.checking = numbers + 3 * file.problem_count;
  int good = 1;
  for (size_t i = 0; i < file.mesh_count && good; i++)
    good = load(&file, &file.meshes[i], &meshes[i], &t);
  for (size_t i = 0; i < file.problem_count && good; i++)
    good = one(&file, &file.problems[i], meshes, clearance, own, bytes, &t);
  printf(
      "%s: %zu of %zu free certified, %zu of %zu hits (at most %.3g ms), %zu of these free but for "
      "the quanta, %zu disagree, %zu refused\n",
      path, t.certified, t.free, t.shown, t.hits, t.worst, t.touch, t.disagree, t.refused);
  printf("  %-22s %10s %10s %10s %10s\n", "", "median", "mean", "90 %", "most");
  row("bytes", t.bytes, t.certified);
  row("visits", t.visits, t.certified);
  row("making, ms", t.making, t.certified);
  row("checking, ms", t.checking, t.certified);
  printf("  trees of %zu meshes: %.3g ms, the checker's %.3g ms\n", file.mesh_count, 1e3 * t.trees,
         1e3 * t.check_trees);
  return good && !t.disagree && !t.refused;
}

int main(int argc, char **argv) {
  float clearance = 0;
  int own = 0;
  int good = 1;
  for (int i = 1; i < argc; i++) {
    if (strcmp(argv[i], "--own") == 0)
      own = 1;
    else if (strcmp(argv[i], "--clearance") == 0 && i + 1 < argc)
      clearance = (float)atof(argv[++i]);
    else
      good &= bench(argv[i], clearance, own);
  }
  return good ? 0 : 1;
}
