// profile.c - where a query's time goes: each stage of nsvcd_sweep by itself, on the problems of a
// file.
//
//   profile FILE [N...]
//
// Prints the median and the mean, in microseconds, over the problems; warm, the least of five runs;
// the clock's own 0.03 to 0.05 us are in each number. Stages of a query at the defaults: base
// decoder, 8 pairs, the 32 deepest ranked. Then the proof, verdict by verdict: time and units.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../any_query.h"
#define PROGRAM "profile"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/shapes.h"
#include "../question_of.h"
#include "../../examples/scenery/status_of.h"
#include "meter.h"

#define SCALE(factor)      \
  (const float[3]) {       \
    factor, factor, factor \
  }

enum { INIT, CUT, BEGIN, STEPS, PAIRS, INVARIANTS, TINY, BASE, BASE_INT8, INSIDE, ALL, STAGES };
static const char *const names[STAGES] = {
    "poses checked",          "motion cut",
    "groups against groups",  "intervals of all moving groups",
    "16 pairs: geometry",     "16 pairs: invariants",
    "16 pairs: tiny decoder", "8 pairs: base decoder",
    "8 pairs: base in int8",  "containment",
    "a query, whole"};

typedef struct question {
  const nsvcd_body *moving, *fixed;
  const nsvcd_pose *poses, *fixed_pose;
  size_t count;
} question;

static void keep_least(double *times, size_t stage, double since) {
  times[stage] = fmin(times[stage], 1e6 * (seconds() - since));
}

// Any number of pairs, as many at a time as nsvcd__decode takes.
static void ask_decoder(const nsvcd__decoder *head, const float *x, size_t count, int int8,
                        float (*said)[NSVCD__DECODER_OUT]) {
  for (size_t first = 0; first < count; first += NSVCD__ROWS) {
    const size_t rows = count - first < NSVCD__ROWS ? count - first : NSVCD__ROWS;
    nsvcd__decoder_run(head, x + NSVCD__DECODER_IN * first, rows, int8, said + first);
  }
}

// One run of every stage; times: (STAGES), the least so far.
static void run_stages(const question *q, nsvcd__query *work, double *times) {
  nsvcd__motion motion;
  nsvcd__candidates kept;
  nsvcd__candidate *batch[NSVCD__BATCH];
  nsvcd__pairs pairs[NSVCD__BATCH / NSVCD__SLICE];
  static float x[NSVCD__BATCH * NSVCD__DECODER_IN], said[NSVCD__BATCH][NSVCD__DECODER_OUT];
  double start = seconds();
  const nsvcd_question asked =
      question_of(q->moving, q->poses, q->count, q->fixed, q->fixed_pose, NULL);
  (void)nsvcd__question_check(&asked);
  nsvcd__motion_init(&asked.a, &asked.b, &motion);
  keep_least(times, INIT, start);
  start = seconds();
  nsvcd__cut_motion(&motion, q->moving->extent + q->fixed->extent, &work->broad_phase);
  keep_least(times, CUT, start);
  nsvcd__plane_cache_begin(&work->broad_phase, 0);
  start = seconds();
  int more = nsvcd__search_begin(q->moving, q->fixed, ~(uint64_t)0, &work->broad_phase);
  keep_least(times, BEGIN, start);
  nsvcd__candidates_start(&kept, work->kept, NSVCD__SHORTLIST * NSVCD_DEFAULT_PAIRS);
  start = seconds();
  while (more) more = nsvcd__search_step(&work->broad_phase, &kept);
  keep_least(times, STEPS, start);
  start = seconds();
  const nsvcd__transform pose = {nsvcd__mat3_lane(work->broad_phase.blocks->rotation, 0),
                                 nsvcd__lane_of(work->broad_phase.blocks->position, 0)};
  (void)nsvcd__is_contained(q->moving, q->fixed, 1, &pose);
  keep_least(times, INSIDE, start);
  if (!kept.count) return;
  for (size_t k = 0; k < NSVCD__BATCH; k++) batch[k] = &kept.items[k % kept.count];
  start = seconds();
  NSVCD__EACH_SLICE(l) {
    nsvcd__pairs_of(q->moving, q->fixed, &motion, batch + l, NSVCD__SLICE,
                    &pairs[l / NSVCD__SLICE]);
  }
  keep_least(times, PAIRS, start);
  start = seconds();
  NSVCD__EACH_SLICE(l) {
    nsvcd__invariants(&pairs[l / NSVCD__SLICE], NSVCD__SLICE, x + NSVCD__DECODER_IN * l);
  }
  keep_least(times, INVARIANTS, start);
  start = seconds();
  ask_decoder(&nsvcd_w_decoders[0], x, 16, 0, said);
  keep_least(times, TINY, start);
  start = seconds();
  ask_decoder(&nsvcd_w_decoders[2], x, 8, 0, said);
  keep_least(times, BASE, start);
  start = seconds();
  ask_decoder(&nsvcd_w_decoders[2], x, 8, 1, said);
  keep_least(times, BASE_INT8, start);
}

static const nsvcd_body *encode(const char *from, const char *path, size_t points, void *memory) {
  char full[4096];
  const char *slash = strrchr(from, '/');
  nsvcd_encode_options options = {.patches = points, .no_triangles = 1};
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  snprintf(full, sizeof full, "%.*s%s", slash ? (int)(slash - from) + 1 : 0, from, path);
  nsvcd_result result = nsvcd_obj_load(full, NULL, &mesh, NULL);
  if (!result) result = nsvcd_encode(&mesh, &options, NULL, memory, nsvcd_body_size(points), &body);
  if (result) {
    complain("%s: %s", full, nsvcd_result_string(result));
    exit(REFUSED);
  }
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}

static void refused(void) {
  fprintf(stderr, "profile: a question is refused\n");
  exit(1);
}

// What a sampling planner asks: ROLLOUTS motions about one, each off by a bump of N(0, a tenth of
// the moving body's radius) per axis at mid-motion; one by one, and in a batch. Adds the
// microseconds per motion.
#define ROLLOUTS 64
static void time_rollouts(const question *q, nsvcd__query *work, uint64_t *random, double *single,
                          double *batch, size_t *alike) {
  static nsvcd_pose poses[ROLLOUTS * 64];
  static nsvcd_answer one[ROLLOUTS], many[ROLLOUTS];
  static nsvcd_question questions[ROLLOUTS];
  const float radius = 0.1f * nsvcd_body_describe(q->moving).radius;
  double least[2] = {1e9, 1e9};
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  if (q->count > 64) return;
  for (size_t m = 0; m < ROLLOUTS; m++) {
    float bump[3];
    for (size_t k = 0; k < 3; k++) {
      double sum = -6;  // of 12 uniform numbers, less their mean: near enough to normal
      for (int n = 0; n < 12; n++) {
        *random = *random * 6364136223846793005u + 1442695040888963407u;
        sum += (double)(*random >> 40) / 16777216;
      }
      bump[k] = radius * (float)sum;
    }
    for (size_t t = 0; t < q->count; t++) {
      const double u = q->count > 1 ? (double)t / (double)(q->count - 1) : 0;
      poses[m * q->count + t] = q->poses[t];
      for (size_t k = 0; k < 3; k++)
        poses[m * q->count + t].position[k] += bump[k] * (float)(4 * u * (1 - u));
    }
  }
  for (size_t m = 0; m < ROLLOUTS; m++) {
    questions[m] =
        question_of(q->moving, poses + m * q->count, q->count, q->fixed, q->fixed_pose, NULL);
    questions[m].method = NSVCD_METHOD_NETWORK;
  }
  for (int run = 0; run < 3; run++) {
    double start = seconds();
    for (size_t m = 0; m < ROLLOUTS; m++) {
      if (nsvcd_sweep(&questions[m], work, size, &one[m])) refused();
    }
    least[0] = fmin(least[0], seconds() - start);
    start = seconds();
    if (nsvcd_sweep_batch(questions, ROLLOUTS, work, size, many)) refused();
    least[1] = fmin(least[1], seconds() - start);
  }
  for (size_t m = 0; m < ROLLOUTS; m++) *alike += collides_of(&one[m]) == collides_of(&many[m]);
  *single += 1e6 * least[0] / ROLLOUTS, *batch += 1e6 * least[1] / ROLLOUTS;
}

// Fused multiply-adds that wait for nothing: what the decoder could reach at best, GFLOP/s.
static double peak_gflops(void) {
  nsvcd__v sum[12];
  nsvcd__v x = nsvcd__v_set(0.999f);
  nsvcd__v y = nsvcd__v_set(0.001f);
  const size_t turns = 1000000;
  double best = 0;
  for (int run = 0; run < 5; run++) {
    for (size_t k = 0; k < 12; k++) sum[k] = nsvcd__v_set((float)k);
    const double start = seconds();
    for (size_t n = 0; n < turns; n++) {
      NSVCD__UNROLL
      for (size_t k = 0; k < 6; k++) {
        sum[k] = nsvcd__v_fma(sum[k], x, y);
        sum[k + 6] = nsvcd__v_fma(sum[k + 6], x, y);
      }
    }
    const double gflops = 12.0 * 2 * NSVCD__LANES * (double)turns / (seconds() - start) * 1e-9;
    volatile float sink;
    float lanes[NSVCD__LANES];
    for (size_t k = 1; k < 12; k++) sum[0] = nsvcd__v_add(sum[0], sum[k]);
    nsvcd__v_store(lanes, sum[0]);
    sink = lanes[0];
    (void)sink;
    best = fmax(best, gflops);
  }
  return best;
}

// Batches of `rows` pairs through a head, GFLOP/s.
static double head_gflops(size_t model, size_t rows, int int8) {
  static float x[NSVCD__BATCH * NSVCD__DECODER_IN], said[NSVCD__BATCH][NSVCD__DECODER_OUT];
  const nsvcd__decoder *head = &nsvcd_w_decoders[model];
  double flops = 0;
  double best = 0;
  for (size_t k = 0; k < NSVCD__BATCH * NSVCD__DECODER_IN; k++) x[k] = (float)(k % 7) / 7 - 0.5f;
  for (size_t l = 0; l < head->layers; l++) flops += 2.0 * head->sizes[l] * head->sizes[l + 1];
  for (int run = 0; run < 5; run++) {
    const double start = seconds();
    for (int n = 0; n < 5000; n++) ask_decoder(head, x, rows, int8, said);
    best = fmax(best, 5000 * flops * (double)rows / (seconds() - start) * 1e-9);
  }
  return best;
}

static void profile(const problem_file *file, size_t points) {
  const size_t size = nsvcd_body_size(points);
  const size_t count = file->problem_count;
  char *bodies = (char *)allocate(file->mesh_count * size);
  void *moving_memory = allocate(size);
  void *fixed_memory = allocate(size);
  nsvcd__query *work = any_query();
  double single = 0;
  double batch = 0;
  size_t alike = 0;
  size_t rolled = 0;
  uint64_t random = 1;
  double *times = (double *)allocate(STAGES * count * sizeof *times);
  double one[STAGES];
  for (size_t i = 0; i < file->mesh_count; i++)
    encode(file->path, file->meshes[i].path, points, bodies + i * size);
  for (size_t i = 0; i < count; i++) {
    const problem *p = &file->problems[i];
    question q = {NULL, NULL, file->poses + p->first_pose, &p->fixed_pose, p->count};
    nsvcd_answer answer;
    nsvcd_body_scale((const nsvcd_body *)(bodies + p->moving * size), SCALE(p->moving_scale),
                     moving_memory, size, &q.moving);
    nsvcd_body_scale((const nsvcd_body *)(bodies + p->fixed * size), SCALE(p->fixed_scale),
                     fixed_memory, size, &q.fixed);
    for (size_t s = 0; s < STAGES; s++) one[s] = 1e9;
    for (int run = 0; run < 5; run++) run_stages(&q, work, one);
    for (int run = 0; run < 5; run++) {
      const nsvcd_question question =
          question_of(q.moving, q.poses, q.count, q.fixed, q.fixed_pose, NULL);
      double start = seconds();
      nsvcd_sweep(&question, work, nsvcd_sweep_workspace_size(NULL), &answer);
      keep_least(one, ALL, start);
    }
    if (i % 10 == 0) {
      time_rollouts(&q, work, &random, &single, &batch, &alike);
      rolled++;
    }
    for (size_t s = 0; s < STAGES; s++) times[s * count + i] = one[s] < 1e9 ? one[s] : 0;
  }
  printf("N = %zu, %zu problems\n", points, count);
  for (size_t s = 0; s < STAGES; s++) {
    double mean = 0;
    for (size_t i = 0; i < count; i++) mean += times[s * count + i] / (double)count;
    meter_sort(times + s * count, count);
    printf("  %-32s median %6.2f  mean %6.2f us\n", names[s], times[s * count + count / 2], mean);
  }
  printf(
      "  a motion of %d about each 10th: one by one %.2f, in a batch %.2f us: x %.2f; %.3f %% "
      "alike\n",
      ROLLOUTS, single / (double)rolled, batch / (double)rolled, batch / single,
      100 * (double)alike / (double)(rolled * ROLLOUTS));
  free(bodies);
  free(moving_memory);
  free(fixed_memory);
  free(work);
  free(times);
}

// What the proofs that end in one verdict took, in all.
typedef struct verdict_sum {
  size_t count;
  double microseconds, work;
} verdict_sum;

static void add_proof(const question *q, nsvcd__query *work, verdict_sum *sums, double *least) {
  nsvcd_answer answer;
  const nsvcd_question question =
      question_of(q->moving, q->poses, q->count, q->fixed, q->fixed_pose, NULL);
  *least = 1e9;
  for (int run = 0; run < 5; run++) {
    const double start = seconds();
    nsvcd_sweep(&question, work, nsvcd_sweep_workspace_size(NULL), &answer);
    keep_least(least, 0, start);
  }
  verdict_sum *sum = &sums[status_of(&answer)];
  sum->count++;
  sum->microseconds += *least;
  sum->work += (double)answer.work;
}

static void profile_proof(const problem_file *file, size_t points) {
  const size_t count = file->problem_count;
  const char *slash = strrchr(file->path, '/');
  const nsvcd_body **bodies = (const nsvcd_body **)allocate(file->mesh_count * sizeof *bodies);
  nsvcd__query *work = any_query();
  double *times = (double *)allocate(count * sizeof *times);
  verdict_sum sums[STATUS_UNDECIDED + 1];
  size_t size = 1;
  memset(sums, 0, sizeof sums);
  for (size_t i = 0; i < file->mesh_count; i++) {
    const nsvcd_encode_options options = {.patches = points};
    char path[4096];
    nsvcd_mesh mesh;
    snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - file->path) + 1 : 0, file->path,
             file->meshes[i].path);
    nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, NULL);
    if (!result) result = nsvcd_encode(&mesh, &options, NULL, NULL, 0, &bodies[i]);
    if (result) {
      complain("%s: %s", path, nsvcd_result_string(result));
      exit(REFUSED);
    }
    nsvcd_mesh_free(&mesh, NULL);
    const size_t bytes = nsvcd_body_describe(bodies[i]).size;
    size = bytes > size ? bytes : size;
  }
  void *moving_memory = allocate(size);
  void *fixed_memory = allocate(size);
  for (size_t i = 0; i < count; i++) {
    const problem *p = &file->problems[i];
    question q = {NULL, NULL, file->poses + p->first_pose, &p->fixed_pose, p->count};
    nsvcd_body_scale(bodies[p->moving], SCALE(p->moving_scale), moving_memory, size, &q.moving);
    nsvcd_body_scale(bodies[p->fixed], SCALE(p->fixed_scale), fixed_memory, size, &q.fixed);
    add_proof(&q, work, sums, &times[i]);
  }
  double mean = 0;
  for (size_t i = 0; i < count; i++) mean += times[i] / (double)count;
  meter_sort(times, count);
  printf("proof, N = %zu, %zu problems: median %.2f, mean %.2f, 99 %% %.1f, worst %.1f us\n",
         points, count, times[count / 2], mean, times[(size_t)(0.99 * (double)count)],
         times[count - 1]);
  for (size_t k = 0; k <= STATUS_UNDECIDED; k++) {
    const verdict_sum *sum = &sums[k];
    const double n = (double)sum->count;
    if (!sum->count) continue;
    printf("  %-15s %5zu, mean %6.2f us, %6.1f units\n", status_string((status)k), sum->count,
           sum->microseconds / n, sum->work / n);
  }
  for (size_t i = 0; i < file->mesh_count; i++) nsvcd_body_free(bodies[i], NULL);
  free(bodies);
  free(work);
  free(times);
  free(moving_memory);
  free(fixed_memory);
}

// What comes before the first query: a torus of 10,000 triangles, written as OBJ, read and encoded.
static void time_preparation(void) {
  const char *path = "build/profile.obj";
  shapes_mesh torus = {0};
  nsvcd_mesh mesh;
  const nsvcd_body *body;
  double megabytes = 0;
  double parse = 1e9;
  shapes_torus(&torus, 0.15, 0.05, 100, 50);
  if (torus.failed || !shapes_write_obj(&torus, path)) {
    complain("%s: cannot be written", path);
    exit(REFUSED);
  }
  FILE *file = fopen(path, "rb");
  char *text = (char *)allocate(1 << 22);
  const size_t size = file ? fread(text, 1, 1 << 22, file) : 0;
  if (!file || fclose(file)) {
    complain("%s: cannot be read", path);
    exit(REFUSED);
  }
  for (int run = 0; run < 9; run++) {
    const double start = seconds();
    nsvcd_result result = nsvcd_obj_parse(text, size, NULL, &mesh, NULL);
    megabytes = 1e-6 * (double)size;
    parse = fmin(parse, seconds() - start);
    if (result) {
      complain("%s: %s", path, nsvcd_result_string(result));
      exit(REFUSED);
    }
    if (run < 8) nsvcd_mesh_free(&mesh, NULL);
  }
  printf("a torus of %zu triangles, %.2f MB of OBJ: read at %.0f MB/s; encoded in",
         mesh.triangle_count, megabytes, megabytes / parse);
  for (size_t points = 128; points <= 512; points *= 4) {
    void *memory = allocate(nsvcd_body_size(points));
    nsvcd_encode_options options = {.patches = points, .no_triangles = 1};
    double least = 1e9;
    for (int run = 0; run < 5; run++) {
      const double start = seconds();
      nsvcd_encode(&mesh, &options, NULL, memory, nsvcd_body_size(points), &body);
      least = fmin(least, seconds() - start);
    }
    printf(" %.1f ms at N = %zu%s", 1e3 * least, points, points == 128 ? "," : "\n");
    free(memory);
  }
  nsvcd_mesh_free(&mesh, NULL);
  shapes_free(&torus);
  free(text);
}

int main(int argc, char **argv) {
  problem_file file;
  if (argc < 2) return fprintf(stderr, "profile FILE [N...]\n"), USAGE;
  if (!read_problems(argv[1], &file)) return REFUSED;
  const double peak = peak_gflops();
  printf("fma peak %.0f GFLOP/s\n", peak);
  for (size_t m = 0; m < 3; m++) {
    printf("  %-5s of 4, 8, 16 pairs: %4.0f %4.0f %4.0f %% of it; int8 %4.0f %4.0f %4.0f\n",
           m == 0   ? "tiny"
           : m == 1 ? "small"
                    : "base",
           100 * head_gflops(m, 4, 0) / peak, 100 * head_gflops(m, 8, 0) / peak,
           100 * head_gflops(m, 16, 0) / peak, 100 * head_gflops(m, 4, 1) / peak,
           100 * head_gflops(m, 8, 1) / peak, 100 * head_gflops(m, 16, 1) / peak);
  }
  time_preparation();
  if (argc == 2) profile(&file, NSVCD_DEFAULT_NETWORK_PATCHES);
  profile_proof(&file, NSVCD_DEFAULT_PATCHES);
  for (int i = 2; i < argc; i++) {
    size_t points;
    if (!parse_count(argv[i], 1, NSVCD_MAX_PATCHES, &points))
      return complain("%s: no N", argv[i]), USAGE;
    profile(&file, points);
  }
  free_problems(&file);
  return DONE;
}
