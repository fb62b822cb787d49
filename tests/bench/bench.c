// bench.c - accuracy against time: every method on the same problems, in one process, on one
// thread.
//
//   bench [--quick|--race|--trade] [--limit N] [--out build/tradeoff] NAME=FILE[,FILE...]...
//
// For each set NAME (problem files, examples/FORMATS.md) and each method: rows of settings, with accuracy,
// misses and false alarms, time per query (pose samples in, verdict out; warm, the least of three
// runs), bytes per body and the time to prepare it. Output: OUT.tsv with every row, OUT.svg
// (accuracy against time), and on standard output the fronts - the rows that no other row of the
// same method beats in both - and what NeuralSVCD needs for the same accuracy.
//
// Sets named after an extreme (see problems.c) are answered by NeuralSVCD alone, to see how far it
// leaves the standard. --race: the proof, the network's default and the mesh hierarchy only, on all
// sets. --trade: the few settings of which README's picture is drawn (trade.py).
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "bench"
#include "../arrays.h"
#include "../../examples/scenery/problem_file.h"
#include "chart.h"
#include "convex.h"
#include "grid.h"
#include "mesh.h"
#include "spheres.h"
#include "method.h"
#include "sampler.h"
#include "../../examples/scenery/oracle.h"
#include "../../examples/scenery/poses.h"
#include "../../examples/scenery/status_of.h"
#include "meter.h"

// -------------------------------------------------------------------------------------------- rows

typedef struct row {
  const char *method;
  char setting[72];
  size_t counts[2][2];               // truth, verdict
  double median, mean, high, worst;  // of a query, microseconds; high: 99th percentile
  double bytes, prepare;             // of a body, mean; milliseconds
  size_t undecided;                  // of the proof
  int front;
} row;

typedef struct table {
  row *rows;
  size_t count, capacity;
} table;

static double accuracy_of(const row *r) {
  double right = (double)(r->counts[0][0] + r->counts[1][1]);
  return 100 * right / (right + (double)(r->counts[0][1] + r->counts[1][0]));
}
static double fraction(size_t part, size_t rest) {
  return part + rest ? 100.0 * (double)part / (double)(part + rest) : 0;
}

static row *new_row(table *t, const char *method) {
  t->rows = (row *)room_for_one(t->rows, t->count, &t->capacity, sizeof *t->rows);
  row *r = &t->rows[t->count++];
  memset(r, 0, sizeof *r);
  r->method = method;
  return r;
}

// times: (count), microseconds; sorted here.
static void set_times(row *r, double *times, size_t count) {
  meter_sort(times, count);
  for (size_t i = 0; i < count; i++) r->mean += times[i] / (double)count;
  r->median = times[count / 2];
  r->worst = times[count - 1];
  r->high = times[(size_t)ceil(0.99 * (double)count) - 1];
}

// A row is on its method's front if no other is at least as fast (median) and at least as accurate,
// and better in one.
static void mark_fronts(table *t) {
  for (size_t i = 0; i < t->count; i++) {
    row *r = &t->rows[i];
    r->front = 1;
    for (size_t j = 0; j < t->count && r->front; j++) {
      const row *o = &t->rows[j];
      double da = accuracy_of(o) - accuracy_of(r);
      double dt = r->median - o->median;
      if (strcmp(o->method, r->method) == 0 && da >= 0 && dt >= 0 && (da > 0 || dt > 0))
        r->front = 0;
    }
  }
}

// -------------------------------------------------------------------------------------------- sets

typedef struct problem_set {
  const char *name;
  problem_file files[4];
  nsvcd_mesh *meshes[4];  // (files[i].mesh_count)
  size_t file_count, problems, total;
  int extreme;  // NeuralSVCD alone
} problem_set;

// One problem of a set, whichever file it is in. A quick run sees all files, and steps by a large
// prime: generators go through labels and kinds in turns.
static const problem *get_problem(const problem_set *set, size_t index, size_t *file) {
  if (set->problems < set->total) index = index * 7919 % set->total;
  for (*file = 0; index >= set->files[*file].problem_count; ++*file)
    index -= set->files[*file].problem_count;
  return &set->files[*file].problems[index];
}

static int load_meshes(const problem_file *file, nsvcd_mesh *meshes) {
  const char *slash = strrchr(file->path, '/');
  for (size_t i = 0; i < file->mesh_count; i++) {
    char path[4096];
    snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - file->path) + 1 : 0, file->path,
             file->meshes[i].path);
    nsvcd_result result = nsvcd_obj_load(path, NULL, &meshes[i], NULL);
    if (result) return complain("%s: %s", path, nsvcd_result_string(result));
  }
  return 1;
}

static int is_extreme(const char *name) {
  static const char *const names[] = {"thin",   "spin", "still",  "tiny",  "huge",
                                      "inside", "far",  "cavity", "mixed", "offset"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    if (strcmp(name, names[i]) == 0) return 1;
  return 0;
}

// argument: NAME=FILE[,FILE...]
static int load_set(char *argument, size_t limit, problem_set *set) {
  char *equals = strchr(argument, '=');
  memset(set, 0, sizeof *set);
  if (!equals) return complain("%s: expected NAME=FILE", argument);
  *equals = 0;
  set->name = argument;
  set->extreme = is_extreme(argument);
  // not strtok, which the reader of problems uses
  for (char *path = equals + 1, *next; path; path = next) {
    problem_file *file = &set->files[set->file_count];
    next = strchr(path, ',');
    if (next) *next++ = 0;
    if (set->file_count == 4) return complain("%s: more than four files", set->name);
    if (!read_problems(path, file)) return 0;
    nsvcd_mesh *meshes = (nsvcd_mesh *)allocate(file->mesh_count * sizeof *meshes);
    memset(meshes, 0, file->mesh_count * sizeof *meshes);
    set->meshes[set->file_count++] = meshes;
    if (!load_meshes(file, meshes)) return 0;
    set->problems += file->problem_count;
  }
  set->total = set->problems;
  if (limit && limit < set->total && set->total % 7919) set->problems = limit;
  return set->problems > 0 || complain("%s: no problems", set->name);
}

static void free_set(problem_set *set) {
  for (size_t f = 0; f < set->file_count; f++) {
    for (size_t i = 0; i < set->files[f].mesh_count; i++) nsvcd_mesh_free(&set->meshes[f][i], NULL);
    free(set->meshes[f]);
    free_problems(&set->files[f]);
  }
}

// The clock's verdict on one query: the least of three runs after one to warm up, fewer where they
// are long.
#define TIME(microseconds, query)                                                   \
  do {                                                                              \
    (microseconds) = HUGE_VAL;                                                      \
    for (int run_ = 0; run_ < 4; run_++) {                                          \
      double start_ = seconds(), taken_;                                            \
      query;                                                                        \
      taken_ = 1e6 * (seconds() - start_);                                          \
      if (run_ > 0 || taken_ > 2000) (microseconds) = fmin((microseconds), taken_); \
      if (taken_ > (run_ ? 200 : 2000)) break;                                      \
    }                                                                               \
  } while (0)

// Progress on standard error: what is running, how far.
static void progress(const char *set, const char *method, size_t done, size_t of) {
  static double last;
  double now = seconds();
  if (done < of && now - last < 0.5) return;
  last = now;
  fprintf(stderr, "\r%-12s %-28s %5zu of %-5zu%s", set, method, done, of, done == of ? "\n" : "");
}

// ----------------------------------------------------------------------- methods at discrete times

typedef struct query_setting {
  size_t samples;
  float activation;
} query_setting;

static double clock_ms(double since) {
  return 1e3 * (seconds() - since);
}

// A mesh of its own, times `scale`.
static nsvcd_mesh scaled_mesh(const nsvcd_mesh *mesh, float scale) {
  nsvcd_mesh out = *mesh;
  out.positions = (float *)allocate(3 * mesh->vertex_count * sizeof(float));
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++) out.positions[i] = mesh->positions[i] * scale;
  return out;
}

// Bodies of one method at one preparation. Those that can be scaled are made once per mesh.
typedef struct cupboard {
  const method *m;
  const preparation *how;
  void **unit[4];  // by file and mesh, or NULL where not made yet
  double total_ms, total_bytes;
  size_t made;
} cupboard;

static void *take_body(cupboard *c, const problem_set *set, size_t file, size_t index,
                       float scale) {
  const nsvcd_mesh *mesh = &set->meshes[file][index];
  double start = seconds();
  void *body;
  if (c->m->scaled) {
    void **unit = &c->unit[file][index];
    if (!*unit) {
      *unit = c->m->prepare(mesh, c->how);
      c->total_ms += clock_ms(start);
      c->made++;
      c->total_bytes += *unit ? (double)c->m->bytes(*unit) : 0;
    }
    body = *unit ? c->m->scaled(*unit, scale) : NULL;
  } else {
    nsvcd_mesh own = scaled_mesh(mesh, scale);
    start = seconds();
    body = c->m->prepare(&own, c->how);
    c->total_ms += clock_ms(start);
    c->made++;
    c->total_bytes += body ? (double)c->m->bytes(body) : 0;
    free(own.positions);
  }
  if (body) return body;
  complain("%s: mesh %s cannot be prepared", c->m->name, set->files[file].meshes[index].name);
  exit(REFUSED);
}

// One preparation of a method at many query settings; a row each.
static void run_discrete(table *t, const problem_set *set, const method *m, const preparation *how,
                         const char *label, const query_setting *settings, size_t setting_count) {
  size_t first = t->count;
  double *times = (double *)allocate(setting_count * set->problems * sizeof *times);
  uint16_t(*order)[SAMPLER_MOST] =
      (uint16_t(*)[SAMPLER_MOST])allocate(setting_count * sizeof *order);
  cupboard c;
  memset(&c, 0, sizeof c);
  c.m = m;
  c.how = how;
  for (size_t f = 0; f < set->file_count; f++) {
    c.unit[f] = (void **)allocate(set->files[f].mesh_count * sizeof(void *));
    memset(c.unit[f], 0, set->files[f].mesh_count * sizeof(void *));
  }
  for (size_t k = 0; k < setting_count; k++) {
    row *r = new_row(t, m->name);
    snprintf(r->setting, sizeof r->setting, "%s%zu samples, %+.0f mm", label, settings[k].samples,
             1e3 * (double)settings[k].activation);
    order_of_visiting(settings[k].samples, order[k]);
  }
  for (size_t i = 0; i < set->problems; i++) {
    size_t f;
    const problem *p = get_problem(set, i, &f);
    const nsvcd_pose *poses = set->files[f].poses + p->first_pose;
    void *moving = take_body(&c, set, f, p->moving, p->moving_scale);
    void *fixed = take_body(&c, set, f, p->fixed, p->fixed_scale);
    for (size_t k = 0; k < setting_count; k++) {
      int hit = 0;
      sampler s;
      TIME(times[k * set->problems + i],
           (start_sampler(&s, poses, p->count, &p->fixed_pose, settings[k].samples, order[k]),
            hit = sweep_discrete(m, moving, fixed, &s, settings[k].activation)));
      t->rows[first + k].counts[p->label == 1][hit]++;
    }
    m->release(moving);
    m->release(fixed);
    progress(set->name, m->name, i + 1, set->problems);
  }
  for (size_t k = 0; k < setting_count; k++) {
    row *r = &t->rows[first + k];
    set_times(r, times + k * set->problems, set->problems);
    r->bytes = c.total_bytes / (double)c.made;
    r->prepare = c.total_ms / (double)c.made;
  }
  for (size_t f = 0; f < set->file_count; f++) {
    for (size_t i = 0; i < set->files[f].mesh_count; i++) m->release(c.unit[f][i]);
    free(c.unit[f]);
  }
  free(times);
  free(order);
}

// The sampling ranges of the paper's table 2, and on: samples, activation distance, and what
// prepares the body.
static void run_baselines(table *t, const problem_set *set, int quick) {
  static const size_t all_samples[] = {2, 4, 8, 16, 32, 64, 128, 256};
  static const float all_activations[] = {-0.01f, -0.002f, 0, 0.002f, 0.01f};
  query_setting dense[40], plain[8];
  size_t dense_count = 0;
  size_t plain_count = 0;
  for (size_t i = 0; i < 8; i++) {
    if (quick && (all_samples[i] < 8 || all_samples[i] > 64)) continue;
    plain[plain_count].samples = all_samples[i];
    plain[plain_count++].activation = 0;
    for (size_t k = 0; k < 5; k++) {
      // the far ends of the range, once
      if ((k == 0 || k == 4) && (quick || all_samples[i] != 32)) continue;
      dense[dense_count].samples = all_samples[i];
      dense[dense_count++].activation = all_activations[k];
    }
  }
  preparation how = {0, 0};
#ifdef HAVE_LIBCCD
  run_discrete(t, set, &convex_method, &how, "32 parts, ", dense, dense_count);
  how.points = 64;
  how.detail = 0.005f;
  run_discrete(t, set, &convex_method, &how, "64 fine parts, ", dense, dense_count);
  how.points = 0;
  how.detail = 0;
#else
  fprintf(stderr,
          "convex parts + GJK: libccd is not installed (libccd-dev), so this method is left out\n");
#endif
  run_discrete(t, set, &full_mesh_method, &how, "", plain, plain_count);
  for (size_t factor = 2; factor <= 32; factor *= 2) {
    char label[40];
    how.detail = (float)factor;
    snprintf(label, sizeof label, "factor %zu, ", factor);
    if (!quick || factor >= 16)
      run_discrete(t, set, &simplified_method, &how, label, plain, plain_count);
  }
  static const float voxels[] = {0.01f, 0.03f, 1};
  static const size_t points[] = {0, 100, 300, 1000};
  for (size_t v = 0; v < 3; v++) {
    for (size_t n = 0; n < 4; n++) {
      char label[40];
      if (quick && (v != 1 || n == 0)) continue;
      how.detail = voxels[v];
      how.points = points[n];
      snprintf(label, sizeof label, "voxel %.0f mm, %zu points, ", 1e3 * (double)voxels[v],
               points[n]);
      run_discrete(t, set, &spheres_method, &how, label, dense, dense_count);
    }
  }
  for (size_t n = 250; n <= 4000; n *= 4) {
    char label[40];
    how.detail = 0;
    how.points = n;
    snprintf(label, sizeof label, "%zu points, ", n);
    if (!quick || n == 1000) run_discrete(t, set, &grid_method, &how, label, dense, dense_count);
  }
}

// ------------------------------------------------------------------------------------------ oracle

static double *to_doubles(const nsvcd_mesh *mesh) {
  double *out = (double *)allocate(3 * mesh->vertex_count * sizeof(double));
  for (size_t i = 0; i < 3 * mesh->vertex_count; i++) out[i] = (double)mesh->positions[i];
  return out;
}

static void load_oracle(const nsvcd_mesh *mesh, float scale, oracle_mesh *out) {
  double *positions = to_doubles(mesh);
  if (oracle_mesh_init(out, positions, mesh->vertex_count, mesh->indices, mesh->triangle_count,
                       (double)scale)) {
    free(positions);
    return;
  }
  complain("out of memory");
  exit(REFUSED);
}

// The far end: exact for the continuous motion, in double precision. Not tuned for speed.
static void run_oracle(table *t, const problem_set *set) {
  row *r = new_row(t, "exact oracle");
  double *times = (double *)allocate(set->problems * sizeof *times);
  snprintf(r->setting, sizeof r->setting, "continuous, 0.05 mm");
  for (size_t i = 0; i < set->problems; i++) {
    size_t f;
    const problem *p = get_problem(set, i, &f);
    oracle_mesh moving, fixed;
    double start = seconds();
    load_oracle(&set->meshes[f][p->moving], p->moving_scale, &moving);
    load_oracle(&set->meshes[f][p->fixed], p->fixed_scale, &fixed);
    r->prepare += clock_ms(start) / 2 / (double)set->problems;
    oracle_pose *poses = (oracle_pose *)allocate(p->count * sizeof *poses);
    oracle_pose fixed_pose = pose_widened(&p->fixed_pose);
    for (size_t k = 0; k < p->count; k++)
      poses[k] = pose_widened(&set->files[f].poses[p->first_pose + k]);
    oracle_options options = {5e-5, 5e-5, 0, 0};
    oracle_result found;
    TIME(times[i], found = oracle_sweep(&moving, poses, p->count, &fixed, &fixed_pose, &options));
    r->counts[p->label == 1][found.status != ORACLE_FREE]++;
    oracle_mesh_free(&moving);
    oracle_mesh_free(&fixed);
    free(poses);
    progress(set->name, r->method, i + 1, set->problems);
  }
  set_times(r, times, set->problems);
  free(times);
}

// -------------------------------------------------------------------------------------- NeuralSVCD

static const char *const model_names[] = {"base", "tiny", "small", "base"};

// All meshes of a set, encoded once.
typedef struct shelf {
  const nsvcd_body **bodies[4];  // by file and mesh
  size_t largest;                // bytes
  double bytes, encode_ms;       // mean
} shelf;

static void fill_shelf(const problem_set *set, const nsvcd_encode_options *options, shelf *s) {
  size_t made = 0;
  memset(s, 0, sizeof *s);
  for (size_t f = 0; f < set->file_count; f++) {
    s->bodies[f] = (const nsvcd_body **)allocate(set->files[f].mesh_count * sizeof *s->bodies[f]);
    for (size_t i = 0; i < set->files[f].mesh_count; i++, made++) {
      const double start = seconds();
      const nsvcd_result result =
          nsvcd_encode(&set->meshes[f][i], options, NULL, NULL, 0, &s->bodies[f][i]);
      if (result) {
        complain("%s: %s", set->files[f].meshes[i].path, nsvcd_result_string(result));
        exit(REFUSED);
      }
      s->encode_ms += clock_ms(start);
      const size_t size = nsvcd_body_describe(s->bodies[f][i]).size;
      s->bytes += (double)size;
      s->largest = size > s->largest ? size : s->largest;
    }
  }
  s->bytes /= (double)made;
  s->encode_ms /= (double)made;
}
static void free_shelf(const problem_set *set, shelf *s) {
  for (size_t f = 0; f < set->file_count; f++) {
    for (size_t i = 0; i < set->files[f].mesh_count; i++) nsvcd_body_free(s->bodies[f][i], NULL);
    free(s->bodies[f]);
  }
}

// What a row of ours is called.
static void name_setting(const nsvcd_question *o, size_t points, char *name, size_t size) {
  int used;
  if (o->method == NSVCD_METHOD_PROOF) {
    snprintf(name, size, "N %zu", points);
    return;
  }
  used = snprintf(name, size, "N %zu, K %zu, %s%s", points,
                  o->network.pairs ? o->network.pairs : NSVCD_DEFAULT_PAIRS,
                  model_names[o->network.model],
                  o->network.precision == NSVCD_PRECISION_INT8 ? ", int8" : "");
  if (o->network.recall > 0)
    snprintf(name + used, size - (size_t)used, ", recall %g %%", 100 * (double)o->network.recall);
}

// One encoding of all meshes, many query settings. method: the name of the rows.
static void run_ours(table *t, const problem_set *set, const char *method,
                     const nsvcd_encode_options *encode, const nsvcd_question *settings,
                     size_t setting_count) {
  size_t first = t->count;
  size_t workspace_size = nsvcd_sweep_workspace_size(NULL);
  double *times = (double *)allocate(setting_count * set->problems * sizeof *times);
  shelf s;
  fill_shelf(set, encode, &s);
  void *workspace = allocate(workspace_size);
  for (size_t k = 0; k < setting_count; k++) {
    row *r = new_row(t, method);
    name_setting(&settings[k], encode->patches, r->setting, sizeof r->setting);
    r->bytes = s.bytes;
    r->prepare = s.encode_ms;
  }
  for (size_t i = 0; i < set->problems; i++) {
    size_t f;
    const problem *p = get_problem(set, i, &f);
    nsvcd_result result = NSVCD_OK;
    nsvcd_question of_problem = question_of_problem(&set->files[f], p);
    of_problem.a.body = s.bodies[f][p->moving];
    of_problem.b.body = s.bodies[f][p->fixed];
    for (size_t k = 0; k < setting_count && !result; k++) {
      nsvcd_answer a;
      nsvcd_question question = settings[k];
      question.a = of_problem.a;
      question.b = of_problem.b;
      TIME(times[k * set->problems + i],
           result = nsvcd_sweep(&question, workspace, workspace_size, &a));
      t->rows[first + k].counts[p->label == 1][collides_of(&a)]++;
      t->rows[first + k].undecided += a.verdict == NSVCD_UNDECIDED;
    }
    if (result) {
      complain("problem %s: %s", p->id, nsvcd_result_string(result));
      exit(REFUSED);
    }
    progress(set->name, method, i + 1, set->problems);
  }
  for (size_t k = 0; k < setting_count; k++)
    set_times(&t->rows[first + k], times + k * set->problems, set->problems);
  free_shelf(set, &s);
  free(times);
  free(workspace);
}

// The proof, at several resolutions.
static void run_proof(table *t, const problem_set *set, const size_t *all_points, size_t count) {
  nsvcd_question settings;
  memset(&settings, 0, sizeof settings);
  settings.method = NSVCD_METHOD_PROOF;
  for (size_t i = 0; i < count; i++) {
    const nsvcd_encode_options encode = {.patches = all_points[i]};
    run_ours(t, set, "proof", &encode, &settings, 1);
  }
}

// Few methods in one run, for ratios: the hierarchy, the network's default, the proof.
static void run_race(table *t, const problem_set *set) {
  static const query_setting settings[3] = {{16, 0}, {32, 0}, {64, 0}};
  static const size_t points[] = {NSVCD_DEFAULT_PATCHES};
  const preparation how = {0, 0};
  const nsvcd_encode_options encode = {.patches = NSVCD_DEFAULT_NETWORK_PATCHES, .no_triangles = 1};
  nsvcd_question network;
  memset(&network, 0, sizeof network);
  run_discrete(t, set, &full_mesh_method, &how, "", settings, 3);
  run_ours(t, set, "NeuralSVCD", &encode, &network, 1);
  run_proof(t, set, points, 1);
}

// What trade.py draws: the proof, the network's three sizes, and of each sampled method a choice of settings.
static void run_trade(table *t, const problem_set *set) {
  static const size_t points[] = {NSVCD_DEFAULT_PATCHES};
  query_setting settings[10];  // as given, and 2 mm thicker
  nsvcd_question sizes[3];
  preparation how = {0, 0};
  for (size_t i = 0; i < 10; i++) {
    settings[i].samples = (size_t)4 << i % 5;
    settings[i].activation = i < 5 ? 0 : 0.002f;
  }
  run_discrete(t, set, &full_mesh_method, &how, "", settings, 5);
#ifdef HAVE_LIBCCD
  run_discrete(t, set, &convex_method, &how, "32 parts, ", settings, 10);
#endif
  for (int i = 0; i < 4; i++) {
    char label[40];
    how.detail = i < 2 ? 0.01f : 0.03f;
    how.points = i % 2 ? 1000 : 100;
    snprintf(label, sizeof label, "voxel %.0f mm, %zu points, ", 1e3 * (double)how.detail,
             how.points);
    run_discrete(t, set, &spheres_method, &how, label, settings, 10);
  }
  run_proof(t, set, points, 1);
  memset(sizes, 0, sizeof sizes);
  for (int i = 0; i < 3; i++) {
    sizes[i].method = NSVCD_METHOD_NETWORK;
    sizes[i].network.model = (nsvcd_model)(NSVCD_MODEL_TINY + i);
  }
  const nsvcd_encode_options encode = {.patches = NSVCD_DEFAULT_NETWORK_PATCHES, .no_triangles = 1};
  run_ours(t, set, "NeuralSVCD", &encode, sizes, 3);
}

static void run_all_neural(table *t, const problem_set *set, int quick) {
  static const size_t all_points[] = {32, 64, 128, 256, 512};
  static const size_t all_pairs[] = {1, 2, 4, 8, 16, 32, 64, 256};
  static const float recalls[] = {0.99f, 0.999f, 0.9999f};
  nsvcd_question settings[64];
  size_t count = 0;
  memset(settings, 0, sizeof settings);
  for (int model = NSVCD_MODEL_TINY; model <= NSVCD_MODEL_BASE; model++) {
    for (int precision = 0; precision < 2; precision++) {
      for (size_t k = 0; k < 8; k++) {
        if (set->extreme ? all_pairs[k] != 8 || precision
                         : quick && (all_pairs[k] < 4 || all_pairs[k] > 16))
          continue;
        settings[count].network.pairs = all_pairs[k];
        settings[count].network.model = (nsvcd_model)model;
        settings[count++].network.precision = (nsvcd_precision)precision;
      }
    }
    for (size_t k = 0; k < 3; k++) {
      if (set->extreme ? k != 1 : quick) continue;
      settings[count].network.model = (nsvcd_model)model;
      settings[count++].network.recall = recalls[k];
    }
  }
  for (size_t i = 0; i < sizeof all_points / sizeof all_points[0]; i++) {
    if (set->extreme && all_points[i] != 128 && all_points[i] != 512) continue;
    const nsvcd_encode_options encode = {.patches = all_points[i], .no_triangles = 1};
    run_ours(t, set, "NeuralSVCD", &encode, settings, count);
  }
}

// The box, in the fixed body's own units, over the moving body's sweep, grown by half its radius.
static void swept_box(const problem_set *set, size_t f, const problem *p, float *low, float *high) {
  const nsvcd_mesh *mesh = &set->meshes[f][p->moving];
  float reach = 0;
  float to_fixed[9];
  float m[9];
  for (size_t i = 0; i < mesh->vertex_count; i++) {
    reach = fmaxf(reach, p->moving_scale * length3(mesh->positions + 3 * i));
  }
  matrix_of_quat(p->fixed_pose.rotation, m);
  transpose33(m, to_fixed);
  for (size_t k = 0; k < 3; k++) {
    low[k] = HUGE_VALF;
    high[k] = -HUGE_VALF;
  }
  for (size_t i = 0; i < p->count; i++) {
    float away[3], at[3];
    sub3(set->files[f].poses[p->first_pose + i].position, p->fixed_pose.position, away);
    mul33_vec(to_fixed, away, at);
    for (size_t k = 0; k < 3; k++) {
      low[k] = fminf(low[k], (at[k] - 1.5f * reach) / p->fixed_scale);
      high[k] = fmaxf(high[k], (at[k] + 1.5f * reach) / p->fixed_scale);
    }
  }
}

// What a scene requires: of the fixed mesh only the part that the moving body can reach, cut out
// for each problem.
static void run_neural_cut(table *t, const problem_set *set) {
  const size_t size = nsvcd_body_size(NSVCD_DEFAULT_NETWORK_PATCHES);
  const size_t workspace_size = nsvcd_sweep_workspace_size(NULL);
  double *times = (double *)allocate(set->problems * sizeof *times);
  void *memory[2];
  void *workspace = allocate(workspace_size);
  memory[0] = allocate(size);
  memory[1] = allocate(size);
  row *r = new_row(t, "NeuralSVCD");
  snprintf(r->setting, sizeof r->setting, "N %d, K %d, base, fixed mesh cut to the sweep",
           NSVCD_DEFAULT_NETWORK_PATCHES, NSVCD_DEFAULT_PAIRS);
  for (size_t i = 0; i < set->problems; i++) {
    size_t f;
    const problem *p = get_problem(set, i, &f);
    float low[3], high[3];
    const nsvcd_body *moving = NULL;
    const nsvcd_body *fixed = NULL;
    nsvcd_encode_options whole = {.no_triangles = 1};
    nsvcd_encode_options open = {.open = 1, .no_triangles = 1};
    nsvcd_mesh part;
    nsvcd_answer a;
    memset(&a, 0, sizeof a);
    swept_box(set, f, p, low, high);
    double start = seconds();
    nsvcd_result result = nsvcd_mesh_cut(&set->meshes[f][p->fixed], low, high, NULL, &part);
    if (result == NSVCD_ERROR_EMPTY) {  // nothing within reach: free
      times[i] = 0;
      r->counts[p->label == 1][0]++;
      continue;
    }
    if (!result) result = nsvcd_encode(&part, &open, NULL, memory[1], size, &fixed);
    r->prepare += clock_ms(start) / (double)set->problems;
    if (!result)
      result = nsvcd_encode(&set->meshes[f][p->moving], &whole, NULL, memory[0], size, &moving);
    if (result) {
      complain("problem %s: %s", p->id, nsvcd_result_string(result));
      exit(REFUSED);
    }
    nsvcd_mesh_free(&part, NULL);
    nsvcd_question question = question_of_problem(&set->files[f], p);
    question.a.body = moving;
    question.b.body = fixed;
    TIME(times[i], result = nsvcd_sweep(&question, workspace, workspace_size, &a));
    r->counts[p->label == 1][collides_of(&a)]++;
    r->bytes += (double)nsvcd_body_describe(fixed).size / (double)set->problems;
    progress(set->name, "NeuralSVCD, cut", i + 1, set->problems);
  }
  set_times(r, times, set->problems);
  free(times);
  free(memory[0]);
  free(memory[1]);
  free(workspace);
}

// ------------------------------------------------------------------------------------------ output

static void write_rows(FILE *file, const problem_set *set, const table *t) {
  for (size_t i = 0; i < t->count; i++) {
    const row *r = &t->rows[i];
    fprintf(file, "%s\t%s\t%s\t%d\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\t%.0f\t%.2f\n",
            set->name, r->method, r->setting, r->front, accuracy_of(r),
            fraction(r->counts[1][0], r->counts[1][1]), fraction(r->counts[0][1], r->counts[0][0]),
            r->median, r->mean, r->high, r->worst, r->bytes, r->prepare);
  }
}

// Our best row for a rival's accuracy (the fastest that reaches it) or for its time (the most
// accurate within it).
static const row *match(const table *t, const row *rival, int by_accuracy) {
  const row *best = NULL;
  for (size_t i = 0; i < t->count; i++) {
    const row *r = &t->rows[i];
    if (strcmp(r->method, "NeuralSVCD") != 0 && strcmp(r->method, "proof") != 0) continue;
    if (by_accuracy ? accuracy_of(r) < accuracy_of(rival) : r->median > rival->median) continue;
    if (!best || (by_accuracy ? r->median < best->median : accuracy_of(r) > accuracy_of(best)))
      best = r;
  }
  return best;
}

static int by_method_and_time(const void *a, const void *b) {
  const row *x = *(row *const *)a;
  const row *y = *(row *const *)b;
  int order = strcmp(x->method, y->method);
  return order ? order : (x->median > y->median) - (x->median < y->median);
}

// The fronts as a Markdown table; all rows of an extreme set.
static void print_rows(const problem_set *set, const table *t) {
  row **shown = (row **)allocate(t->count * sizeof *shown);
  size_t count = 0;
  for (size_t i = 0; i < t->count; i++)
    if (t->rows[i].front || set->extreme) shown[count++] = &t->rows[i];
  qsort(shown, count, sizeof *shown, by_method_and_time);
  printf("\n%s, %zu problems\n\n", set->name, set->problems);
  printf(
      "| method, setting | right [95 %%] | missed | stopped | us: median / mean / 99 %% / worst | "
      "KB a body | ms to "
      "prepare |"
      " ours for the same accuracy: times its time | ours in the same time: points "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (size_t i = 0; i < count; i++) {
    const row *r = shown[i];
    size_t right = r->counts[0][0] + r->counts[1][1];
    double low, high;
    wilson(right, set->problems, &low, &high);
    char undecided[40] = "";
    if (r->undecided) snprintf(undecided, sizeof undecided, ", %zu undecided", r->undecided);
    printf(
        "| %s, %s%s | %.2f [%.2f, %.2f] | %.2f | %.2f | %.1f / %.1f / %.0f / %.0f | %.1f | %.1f |",
        r->method, r->setting, undecided, accuracy_of(r), 100 * low, 100 * high,
        fraction(r->counts[1][0], r->counts[1][1]), fraction(r->counts[0][1], r->counts[0][0]),
        r->median, r->mean, r->high, r->worst, r->bytes / 1024, r->prepare);
    const row *same = match(t, r, 1);
    const row *fast = match(t, r, 0);
    int ours = strcmp(r->method, "NeuralSVCD") == 0 || strcmp(r->method, "proof") == 0;
    if (ours || !same)
      printf(" %s |", ours ? "" : "not reached");
    else
      printf(" %.2f |", same->median / r->median);
    if (ours || !fast)
      printf(" %s |\n", ours ? "" : "none as fast");
    else
      printf(" %+.2f |\n", accuracy_of(fast) - accuracy_of(r));
  }
  free(shown);
  fflush(stdout);
}

static void draw_rows(chart *c, const problem_set *set, const table *t) {
  chart_panel(c, set->name, set->problems);
  for (size_t i = 0; i < t->count; i++) {
    const row *r = &t->rows[i];
    chart_point(c, r->method, r->median, accuracy_of(r), r->front);
  }
}

static int usage(void) {
  fprintf(stderr,
          "bench [--quick|--race|--trade] [--limit N] [--out PREFIX] NAME=FILE[,FILE...]...\n");
  return USAGE;
}

int main(int argc, char **argv) {
  static const size_t proof_points[] = {64, 128, NSVCD_DEFAULT_PATCHES, 256, 512};
  int quick = 0;
  int race = 0;
  int trade = 0;
  int i = 1;
  size_t limit = 0;
  const char *out = "build/tradeoff";
  for (; i < argc && strncmp(argv[i], "--", 2) == 0; i++) {
    if (strcmp(argv[i], "--quick") == 0)
      quick = 1;
    else if (strcmp(argv[i], "--race") == 0)
      race = 1;
    else if (strcmp(argv[i], "--trade") == 0)
      trade = 1;
    else if (strcmp(argv[i], "--limit") == 0 && i + 1 < argc &&
             parse_count(argv[i + 1], 1, SIZE_MAX, &limit))
      i++;
    else if (strcmp(argv[i], "--out") == 0 && i + 1 < argc)
      out = argv[++i];
    else
      return usage();
  }
  if (i == argc) return usage();
  char path[1024];
  snprintf(path, sizeof path, "%s.tsv", out);
  FILE *file = fopen(path, "w");
  if (!file) return complain("%s: %s", path, strerror(errno)), REFUSED;
  fprintf(
      file,
      "set\tmethod\tsetting\tfront\taccuracy\tmissed\tstopped\tmedian_us\tmean_us\tp99_us\tworst_"
      "us\tbytes\tprepare_ms\n");
  chart *c = (chart *)allocate(sizeof *c);
  chart_start(c);
  for (; i < argc; i++) {
    problem_set set;
    table t = {NULL, 0, 0};
    if (!load_set(argv[i], limit, &set)) return REFUSED;
    if (race || trade) {
      (trade ? run_trade : run_race)(&t, &set);
      mark_fronts(&t);
      for (size_t k = 0; k < t.count && race; k++) t.rows[k].front = 1;
      write_rows(file, &set, &t);
      print_rows(&set, &t);
      free(t.rows);
      free_set(&set);
      continue;
    }
    if (!set.extreme) {
      run_baselines(&t, &set, quick);
      run_oracle(&t, &set);
    }
    run_proof(&t, &set, proof_points, sizeof proof_points / sizeof proof_points[0]);
    run_all_neural(&t, &set, quick);
    if (strcmp(set.name, "mixed") == 0 || strcmp(set.name, "cavity") == 0) run_neural_cut(&t, &set);
    mark_fronts(&t);
    write_rows(file, &set, &t);
    print_rows(&set, &t);
    if (!set.extreme) draw_rows(c, &set, &t);
    free(t.rows);
    free_set(&set);
  }
  if (fclose(file) != 0) return complain("%s: cannot be written", path), REFUSED;
  snprintf(path, sizeof path, "%s.svg", out);
  int good = chart_write(c, path);
  free(c);
  return good ? DONE : REFUSED;
}
