// bench.c - the loop against version 0.2 on labelled problems, in one process, in turns.
// usage: bench [--passes N] [--limit N] [--slow] [--alone] [--both] [--first SHARE] [--clearance METRES] FILE.txt ...   (files as build/problems makes them)
// Every problem is asked N times of each, in turns, and the least time counts. Both bodies are in
// memory; 0.2's answers hold points and normals, which the loop does not reckon.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../../neuralsvcd.h"
#define PROGRAM "bench"
#include "../../../examples/scenery/problem_file.h"
#include "../../../examples/scenery/status_of.h"

#include "build.h"
#include "inside.h"

typedef struct bodies {
  const nsvcd_body *old;
  tree_body *tree;
} bodies;

typedef struct tally {
  size_t right, wrong, undecided, count[2];
  double *times[2];  // by label
} tally;

static size_t total_bytes[2], total_triangles, total_bodies;

// Bodies are kept in a folder, if LOOP_CACHE names one: blobs by the mesh's path.
static void *cached(const char *path, const char *kind, size_t *size, const void *write) {
  char name[4200];
  const char *folder = getenv(kind);
  void *out = NULL;
  if (!folder)
    return NULL;
  int n = snprintf(name, sizeof name, "%s/", folder);
  for (const char *c = path; *c && n < 4190; c++)
    name[n++] = *c == '/' || *c == '.' ? '_' : *c;
  name[n] = 0;
  FILE *file = fopen(name, write ? "wb" : "rb");
  if (!file)
    return NULL;
  if (write) {
    fwrite(write, 1, *size, file);
  } else {
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    if (posix_memalign(&out, 64, *size + 256) || fread(out, 1, *size, file) != *size)
      out = NULL;
  }
  fclose(file);
  return out;
}

static int load_bodies(const problem_file *file, bodies *out) {
  for (size_t i = 0; i < file->mesh_count; i++) {
    char path[4096];
    const char *slash = strrchr(file->path, '/');
    nsvcd_mesh mesh;
    snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash - file->path + 1) : 0, file->path,
             file->meshes[i].path);
    nsvcd_encode_options options;
    memset(&options, 0, sizeof options);
    if (nsvcd_obj_load(path, NULL, &mesh, NULL))
      return complain("%s: cannot be read", path);
    size_t size;
    out[i].old = (const nsvcd_body *)cached(path, "OLD_CACHE", &size, NULL);
    out[i].tree = (tree_body *)cached(path, "TREE_CACHE", &size, NULL);
    if (!out[i].old) {
      if (nsvcd_encode(&mesh, &options, NULL, NULL, 0, &out[i].old))
        return complain("%s: cannot be encoded", path);
      size = nsvcd_body_describe(out[i].old).size;
      cached(path, "OLD_CACHE", &size, out[i].old);
    }
    if (!out[i].tree) {
      out[i].tree = build_body(&mesh, &default_cut);
      size = out[i].tree->bytes;
      cached(path, "TREE_CACHE", &size, out[i].tree);
    }
    total_bytes[0] += nsvcd_body_describe(out[i].old).size;
    total_bytes[1] += out[i].tree->bytes;
    total_triangles += mesh.triangle_count;
    total_bodies++;
    nsvcd_mesh_free(&mesh, NULL);
  }
  return 1;
}

static int compare_doubles(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return x < y ? -1 : x > y;
}

static void print_times(double *times, size_t n) {
  double sum = 0;
  if (!n)
    return;
  qsort(times, n, sizeof *times, compare_doubles);
  for (size_t i = 0; i < n; i++)
    sum += times[i];
  printf(" | %6.2f %6.2f %6.1f %6.1f", times[n / 2], sum / (double)n, times[(n - 1) * 99 / 100],
         times[n - 1]);
}

static void print_tally(const char *name, tally *t) {
  double *all = (double *)allocate(sizeof *all * (t->count[0] + t->count[1]));
  memcpy(all, t->times[0], sizeof *all * t->count[0]);
  memcpy(all + t->count[0], t->times[1], sizeof *all * t->count[1]);
  printf("  %-5s %4zu right %2zu wrong %2zu undecided", name, t->right, t->wrong, t->undecided);
  print_times(t->times[0], t->count[0]);
  print_times(t->times[1], t->count[1]);
  print_times(all, t->count[0] + t->count[1]);
  printf("\n");
  free(all);
}

static void note(tally *t, int label, int hit, int undecided, double time) {
  t->undecided += undecided != 0;
  t->right += !undecided && hit == label;
  t->wrong += !undecided && hit != label;
  t->times[label][t->count[label]++] = 1e6 * time;
}

int main(int argc, char **argv) {
  size_t passes = 7;
  size_t limit = (size_t)-1;
  int slow = 0;
  int alone = 0;
  int both = 0;
  float first = 0;
  float clearance = 0;
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "--passes")) {
      passes = (size_t)atoi(argv[++i]);
      continue;
    }
    if (!strcmp(argv[i], "--limit")) {
      limit = (size_t)atoi(argv[++i]);
      continue;
    }
    if (!strcmp(argv[i], "--slow")) {
      slow = 1;
      continue;
    }
    if (!strcmp(argv[i], "--first")) {
      first = (float)atof(argv[++i]);
      continue;
    }
    if (!strcmp(argv[i], "--clearance")) {
      clearance = (float)atof(argv[++i]);
      continue;
    }
    if (!strcmp(argv[i], "--both")) {
      both = 1;
      continue;
    }
    if (!strcmp(argv[i], "--alone")) {
      alone = 1;
      continue;
    }
    problem_file file;
    if (!read_problems(argv[i], &file))
      return 1;
    bodies *all = (bodies *)allocate(file.mesh_count * sizeof *all);
    if (!load_bodies(&file, all))
      return 1;
    tally tallies[2];
    memset(tallies, 0, sizeof tallies);
    for (int k = 0; k < 4; k++)
      tallies[k / 2].times[k % 2] = (double *)allocate(file.problem_count * sizeof(double));
    loop_answer sum[2];
    uint32_t most_waiting = 0;
    memset(sum, 0, sizeof sum);
    for (size_t n = 0; n < file.problem_count && n < limit; n++) {
      const problem *p = &file.problems[n];
      nsvcd_question q = question_of_problem(&file, p);
      q.a.body = all[p->moving].old;
      q.b.body = all[p->fixed].old;
      q.method = NSVCD_METHOD_PROOF;
      q.ask = first > 0 ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
      q.to_time = first;
      q.clearance = clearance;
      nsvcd_pose drift[4];
      int label = p->label;
      if (both) {  // the other body moves a little too; version 0.2 says what is right
        for (int k = 0; k < 4; k++) {
          const float turn = 0.05f * (float)k * (n % 2 ? 1 : -1);
          drift[k] = p->fixed_pose;
          drift[k].position[k % 3] += 0.003f * (float)k;
          const float *r = p->fixed_pose.rotation;
          const float c = cosf(turn);
          const float t = sinf(turn);
          drift[k].rotation[0] = c * r[0] - t * r[1];
          drift[k].rotation[1] = c * r[1] + t * r[0];
          drift[k].rotation[2] = c * r[2] + t * r[3];
          drift[k].rotation[3] = c * r[3] - t * r[2];
        }
        q.b.poses = drift;
        q.b.count = 4;
      }
      const size_t size = nsvcd_sweep_workspace_size(&q);
      void *workspace = allocate(size);
      void *memory = NULL;
      if (posix_memalign(&memory, 64, loop_memory((uint32_t)(p->count + p->fixed_count + 6))))
        return 1;
      double best[2] = {HUGE_VAL, HUGE_VAL};
      nsvcd_answer old;
      loop_answer now;
      memset(&old, 0, sizeof old);
      memset(&now, 0, sizeof now);
      for (size_t pass = 0; pass < passes; pass++) {
        const double t0 = seconds();
        if (!loop_sweep(&q, all[p->moving].tree, all[p->fixed].tree, memory, &now))
          return complain("%s: refused", p->id), 1;
        const double t1 = seconds();
        if ((!alone || !pass) && nsvcd_sweep(&q, workspace, size, &old))
          return complain("%s: refused", p->id), 1;
        const double t2 = seconds();
        best[0] = fmin(best[0], t1 - t0);
        best[1] = fmin(best[1], t2 - t1);
      }
      if (both || clearance > 0)
        label = collides_of(&old);
      const int hit = now.verdict == LOOP_HIT || now.verdict == LOOP_INSIDE;
      note(&tallies[0], label, hit, now.verdict == LOOP_UNDECIDED, best[0]);
      note(&tallies[1], label, collides_of(&old), old.verdict == NSVCD_UNDECIDED, best[1]);
      if (now.verdict == LOOP_UNDECIDED || hit != label)
        printf("  %s: label %d margin %g, loop says %d at %g, 0.2 %s\n", p->id, p->label, p->margin,
               (int)now.verdict, now.time, status_string(status_of(&old)));
      if (slow && (best[0] > 50e-6 || getenv("ALLP")))
        printf("  %s: label %d margin %g: %.1f us against %.1f; visits %u leaves %u rows %u couples %u "
               "halvings %u; meshes %s %s\n",
               p->id, p->label, p->margin, 1e6 * best[0], 1e6 * best[1], now.visits, now.leaves,
               now.rows, now.couples, now.halvings, file.meshes[p->moving].name,
               file.meshes[p->fixed].name);
      loop_answer *s = &sum[label];
      s->steps += now.steps;
      s->visits += now.visits;
      s->leaves += now.leaves;
      s->rows += now.rows;
      s->couples += now.couples;
      s->halvings += now.halvings;
      s->cuts += now.cuts;
      most_waiting = now.most_waiting > most_waiting ? now.most_waiting : most_waiting;
      free(workspace);
      free(memory);
    }
    printf("%s: %zu problems; us, median mean 99 %% worst: free | hit | all\n", argv[i],
           tallies[0].count[0] + tallies[0].count[1]);
    print_tally("loop", &tallies[0]);
    print_tally("0.2", &tallies[1]);
    for (int label = 0; label < 2; label++) {
      const double c = (double)tallies[0].count[label] + 1e-9;
      printf("  %s, mean: steps %.0f visits %.0f leaves %.0f rows %.0f couples %.0f halvings %.1f cuts %.1f\n",
             label ? "hit" : "free", sum[label].steps / c, sum[label].visits / c,
             sum[label].leaves / c, sum[label].rows / c, sum[label].couples / c,
             sum[label].halvings / c, sum[label].cuts / c);
    }
    printf("  most waiting %u\n", most_waiting);
    free_problems(&file);
  }
  if (total_bodies)
    printf("%zu bodies of %.0f triangles: 0.2 without latents %.1f KB, tree %.1f KB; loop's memory %.1f KB\n",
           total_bodies, (double)total_triangles / (double)total_bodies,
           1e-3 * (double)total_bytes[0] / (double)total_bodies,
           1e-3 * (double)total_bytes[1] / (double)total_bodies,
           1e-3 * (double)loop_memory(33));
  return 0;
}
