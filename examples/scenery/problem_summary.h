// problem_summary.h - what answers to a problem file come to: the share that is right, by bands of
// the margin, statuses, times and bytes. On standard error. Include neuralsvcd.h, problem_file.h and
// status_of.h first.
#ifndef NSVCD_SCENERY_PROBLEM_SUMMARY_H
#define NSVCD_SCENERY_PROBLEM_SUMMARY_H

typedef struct encoded {
  const nsvcd_body *body;  // its units are the file's
  double seconds;          // time that encoding took
} encoded;

typedef struct outcome {  // what came of a problem
  nsvcd_answer answer;
  double microseconds;
} outcome;

typedef struct session {
  problem_file file;
  encoded *bodies;    // (file.mesh_count)
  outcome *outcomes;  // (file.problem_count)
} session;

static void print_share(const char *name, size_t hits, size_t count, const char *of) {
  double low, high;
  if (!count) return;
  wilson(hits, count, &low, &high);
  fprintf(stderr, "%-20s %7.2f %%  [%.2f, %.2f]  %zu of %zu %s\n", name,
          100.0 * (double)hits / (double)count, 100 * low, 100 * high, hits, count, of);
}

#define BANDS 6
static const double band_edges[BANDS] = {0.001, 0.0025, 0.005, 0.010, 0.020, HUGE_VAL};  // metres
static const char *const band_names[BANDS + 1] = {"0 - 1",   "1 - 2.5", "2.5 - 5", "5 - 10",
                                                  "10 - 20", "> 20",    "nan"};

static size_t band_of(double margin) {  // BANDS if unknown
  size_t band = 0;
  if (isnan(margin)) return BANDS;
  while (fabs(margin) > band_edges[band]) band++;
  return band;
}

// Counts by band (BANDS: no margin), truth and verdict.
typedef struct tally {
  size_t at[BANDS + 1][2][2];
} tally;

static size_t tally_sum(const tally *t, int label, int verdict) {
  size_t sum = 0;
  for (size_t band = 0; band <= BANDS; band++) sum += t->at[band][label][verdict];
  return sum;
}
static void print_ratio(size_t right, size_t count) {
  if (!count)
    fprintf(stderr, "  %20s", "-     ");
  else
    fprintf(stderr, "  %6.2f %6zu/%-6zu", 100.0 * (double)right / (double)count, right, count);
}
static void print_bands(const tally *t) {
  fprintf(stderr, "\n%-12s  %20s  %20s  %20s\n", "|margin| mm", "colliding: found, %",
          "free: cleared, %", "both, %");
  for (size_t band = 0; band <= BANDS; band++) {
    const size_t(*at)[2] = t->at[band];
    size_t collide = at[1][0] + at[1][1];
    size_t clear = at[0][0] + at[0][1];
    if (collide + clear == 0) continue;
    fprintf(stderr, "%-12s", band_names[band]);
    print_ratio(at[1][1], collide);
    print_ratio(at[0][0], clear);
    print_ratio(at[1][1] + at[0][0], collide + clear);
    fprintf(stderr, "\n");
  }
}
static void print_accuracy(const session *s) {
  tally t;
  memset(&t, 0, sizeof t);
  for (size_t i = 0; i < s->file.problem_count; i++) {
    const problem *p = &s->file.problems[i];
    if (p->label >= 0) t.at[band_of(p->margin)][p->label][collides_of(&s->outcomes[i].answer)]++;
  }
  size_t missed = tally_sum(&t, 1, 0);
  size_t found = tally_sum(&t, 1, 1);
  size_t cleared = tally_sum(&t, 0, 0);
  size_t alarms = tally_sum(&t, 0, 1);
  if (missed + found + cleared + alarms == 0) return;
  print_share("accuracy", found + cleared, missed + found + cleared + alarms, "right");
  print_share("false negatives", missed, missed + found, "collisions missed");
  print_share("false positives", alarms, alarms + cleared, "free motions stopped");
  print_bands(&t);
}

static void print_statuses(const session *s) {
  fprintf(stderr, "\nstatus:");
  for (int status = STATUS_OK; status <= STATUS_UNDECIDED; status++) {
    size_t count = 0;
    for (size_t i = 0; i < s->file.problem_count; i++)
      count += (int)status_of(&s->outcomes[i].answer) == status;
    fprintf(stderr, "%s %s %.1f %%", status ? "," : "", status_string((enum status)status),
            100.0 * (double)count / (double)s->file.problem_count);
  }
  fprintf(stderr, "\n");
}

static int compare_doubles(const void *a, const void *b) {
  double x = *(const double *)a;
  double y = *(const double *)b;
  return (x > y) - (x < y);
}
// Sorts, and prints median, mean, 99th percentile and worst.
static void print_distribution(const char *name, double *values, size_t count, const char *unit) {
  double sum = 0;
  if (!count) return;
  qsort(values, count, sizeof *values, compare_doubles);
  for (size_t i = 0; i < count; i++) sum += values[i];
  fprintf(stderr, "%s: median %.1f, mean %.1f, 99th percentile %.1f, worst %.1f %s\n", name,
          (values[(count - 1) / 2] + values[count / 2]) / 2, sum / (double)count,
          values[(size_t)ceil(0.99 * (double)count) - 1], values[count - 1], unit);
}
static void print_costs(const session *s) {
  const problem_file *file = &s->file;
  size_t most = file->problem_count > file->mesh_count ? file->problem_count : file->mesh_count;
  double *values = (double *)allocate(most * sizeof(double));
  double bytes = 0;
  double points = 0;
  for (size_t i = 0; i < file->problem_count; i++) values[i] = s->outcomes[i].microseconds;
  print_distribution("a query", values, file->problem_count, "us");
  for (size_t i = 0; i < file->mesh_count; i++) {
    nsvcd_body_facts facts = nsvcd_body_describe(s->bodies[i].body);
    bytes += (double)facts.size / (double)file->mesh_count;
    points += (double)facts.patches / (double)file->mesh_count;
    values[i] = 1e3 * s->bodies[i].seconds;
  }
  print_distribution("encoding a mesh", values, file->mesh_count, "ms");
  if (file->mesh_count) fprintf(stderr, "a body: %.0f bytes, %.1f points (mean)\n", bytes, points);
  free(values);
}

static void print_summary(const session *s) {
  const problem_file *file = &s->file;
  size_t labels[3] = {0, 0, 0};  // -1, 0, 1
  for (size_t i = 0; i < file->problem_count; i++) labels[file->problems[i].label + 1]++;
  fprintf(stderr, "%s: %zu problems (%zu collide, %zu free, %zu without a label), %zu meshes\n",
          file->path, file->problem_count, labels[2], labels[1], labels[0], file->mesh_count);
  if (!file->problem_count) return;
  print_accuracy(s);
  print_statuses(s);
  print_costs(s);
}

#endif
