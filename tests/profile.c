// profile.c - where a query's time goes: each stage of nsvcd_sweep by itself, on the problems of a file.
//
//   profile FILE [N...]
//
// Prints the median and the mean, in microseconds, over the problems; warm, the least of five runs; the clock's own
// 0.03 to 0.05 us are in each number. Stages of a query at the defaults: base decoder, 8 pairs, the 32 deepest ranked.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define PROGRAM "profile"
#include "../examples/problem_file.h"

enum { INIT, CUT, BEGIN, STEPS, PAIRS, INVARIANTS, TINY, BASE, BASE_INT8, INSIDE, ALL, STAGES };
static const char *const names[STAGES] = {"poses checked, arcs",
                                          "motion cut",
                                          "cut, and groups against groups",
                                          "runs of all moving groups",
                                          "16 pairs: geometry",
                                          "16 pairs: invariants",
                                          "16 pairs: tiny decoder",
                                          "8 pairs: base decoder",
                                          "8 pairs: base in int8",
                                          "containment",
                                          "a query, whole"};

typedef struct question {
  const nsvcd_body *moving, *fixed;
  const nsvcd_pose *poses, *fixed_pose;
  size_t count;
} question;

static void keep_least(double *times, size_t stage, double since) {
  times[stage] = fmin(times[stage], 1e6 * (seconds() - since));
}

// One run of every stage; times: (STAGES), the least so far.
static void run_stages(const question *q, nsvcd__query *work, double *times) {
  nsvcd__motion motion;
  nsvcd__candidates kept;
  nsvcd__candidate *batch[NSVCD__BATCH];
  nsvcd__pairs pairs;
  static float x[NSVCD__BATCH * NSVCD__DECODER_IN], logits[NSVCD__BATCH];
  float rotation[9], position[3];
  double start = seconds();
  nsvcd__motion_init(q->poses, q->count, q->fixed_pose, &motion);
  keep_least(times, INIT, start), start = seconds();
  nsvcd__cut_motion(&motion, q->moving->extent + q->fixed->extent, &work->broad_phase);
  keep_least(times, CUT, start), start = seconds();
  int more = nsvcd__search_begin(q->moving, q->fixed, &motion, &work->broad_phase);
  keep_least(times, BEGIN, start);
  nsvcd__candidates_start(&kept, work->kept, NSVCD__SHORTLIST * NSVCD_DEFAULT_PAIRS);
  start = seconds();
  while (more) more = nsvcd__search_step(&work->broad_phase, q->moving, q->fixed, &kept);
  keep_least(times, STEPS, start), start = seconds();
  nsvcd__motion_pose(&motion, 0, rotation, position);
  (void)nsvcd__is_contained(q->moving, q->fixed, rotation, position);
  keep_least(times, INSIDE, start);
  if (!kept.count) return;
  for (size_t k = 0; k < NSVCD__BATCH; k++) batch[k] = &kept.items[k % kept.count];
  start = seconds();
  nsvcd__pairs_of(q->moving, q->fixed, &motion, batch, NSVCD__BATCH, &pairs);
  keep_least(times, PAIRS, start), start = seconds();
  nsvcd__invariants(&pairs, NSVCD__BATCH, x);
  keep_least(times, INVARIANTS, start), start = seconds();
  nsvcd__head_logits(&nsvcd_w_heads[0], x, 16, 0, logits);
  keep_least(times, TINY, start), start = seconds();
  nsvcd__head_logits(&nsvcd_w_heads[2], x, 8, 0, logits);
  keep_least(times, BASE, start), start = seconds();
  nsvcd__head_logits(&nsvcd_w_heads[2], x, 8, 1, logits);
  keep_least(times, BASE_INT8, start);
}

static int compare_doubles(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static const nsvcd_body *encode(const char *from, const char *path, size_t points, void *memory) {
  char full[4096];
  const char *slash = strrchr(from, '/');
  nsvcd_encode_options options = {points, 0, 0};
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  snprintf(full, sizeof full, "%.*s%s", slash ? (int)(slash - from) + 1 : 0, from, path);
  nsvcd_result result = nsvcd_obj_load(full, NULL, &mesh, NULL);
  if (!result) result = nsvcd_encode(&mesh, &options, NULL, memory, nsvcd_body_size(points), &body);
  if (result) complain("%s: %s", full, nsvcd_result_string(result)), exit(REFUSED);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}

static void profile(const problem_file *file, size_t points) {
  const size_t size = nsvcd_body_size(points), count = file->problem_count;
  char *bodies = (char *)allocate(file->mesh_count * size);
  void *moving_memory = allocate(size), *fixed_memory = allocate(size);
  nsvcd__query *work = (nsvcd__query *)allocate(sizeof *work);
  double *times = (double *)allocate(STAGES * count * sizeof *times), one[STAGES];
  for (size_t i = 0; i < file->mesh_count; i++) encode(file->path, file->meshes[i].path, points, bodies + i * size);
  for (size_t i = 0; i < count; i++) {
    const problem *p = &file->problems[i];
    question q = {NULL, NULL, file->poses + p->first_pose, &p->fixed_pose, p->count};
    nsvcd_answer answer;
    nsvcd_body_scale((const nsvcd_body *)(bodies + p->moving * size), p->moving_scale, moving_memory, size, &q.moving);
    nsvcd_body_scale((const nsvcd_body *)(bodies + p->fixed * size), p->fixed_scale, fixed_memory, size, &q.fixed);
    for (size_t s = 0; s < STAGES; s++) one[s] = 1e9;
    for (int run = 0; run < 5; run++) run_stages(&q, work, one);
    for (int run = 0; run < 5; run++) {
      double start = seconds();
      nsvcd_sweep(q.moving, q.poses, q.count, q.fixed, q.fixed_pose, NULL, work, sizeof *work, &answer);
      keep_least(one, ALL, start);
    }
    for (size_t s = 0; s < STAGES; s++) times[s * count + i] = one[s] < 1e9 ? one[s] : 0;
  }
  printf("N = %zu, %zu problems\n", points, count);
  for (size_t s = 0; s < STAGES; s++) {
    double mean = 0;
    for (size_t i = 0; i < count; i++) mean += times[s * count + i] / (double)count;
    qsort(times + s * count, count, sizeof *times, compare_doubles);
    printf("  %-32s median %6.2f  mean %6.2f us\n", names[s], times[s * count + count / 2], mean);
  }
  free(bodies), free(moving_memory), free(fixed_memory), free(work), free(times);
}

int main(int argc, char **argv) {
  problem_file file;
  if (argc < 2) return fprintf(stderr, "profile FILE [N...]\n"), USAGE;
  if (!read_problems(argv[1], &file)) return REFUSED;
  if (argc == 2) profile(&file, NSVCD_DEFAULT_POINTS);
  for (int i = 2; i < argc; i++) {
    size_t points;
    if (!parse_count(argv[i], 1, NSVCD_MAX_POINTS, &points)) return complain("%s: no N", argv[i]), USAGE;
    profile(&file, points);
  }
  free_problems(&file);
  return DONE;
}
