// svcd.c - neuralsvcd.h on the command line: answers a file of problems, encodes a mesh, describes
// a body.
//
// `svcd` without arguments prints how to use it; problem_file.h has the format of problem files.
// Exit status: 0 done, 1 a file or a line was refused (file, line and reason on standard error), 2
// usage.
#define _POSIX_C_SOURCE 200112L  // clock_gettime, posix_memalign
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define PROGRAM "svcd"
#include "scenery/problem_file.h"

// ---------------------------------------------------------------------------------------- encoding

// Loads and encodes one mesh; nsvcd_body_free gives the body back. `from`: what asks for it, for
// messages ("file:line: "), or "".
static const nsvcd_body *encode_file(const char *from, const char *path,
                                     const nsvcd_encode_options *options, double *encode_seconds) {
  nsvcd_mesh mesh;
  size_t line = 0;
  nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, &line);
  if (result && line)
    complain("%s%s:%zu: %s", from, path, line, nsvcd_result_string(result));
  if (result && !line)
    complain("%s%s: %s", from, path, nsvcd_result_string(result));
  if (result)
    return NULL;
  const nsvcd_body *body = NULL;
  double start = seconds();
  result = nsvcd_encode(&mesh, options, NULL, NULL, 0, &body);
  *encode_seconds = seconds() - start;
  nsvcd_mesh_free(&mesh, NULL);
  if (result)
    complain("%s%s: %s", from, path, nsvcd_result_string(result));
  return body;
}

typedef struct encoded {
  const nsvcd_body *body;  // in the units of its file
  double seconds;          // that encoding took
} encoded;

// Every mesh once, in the units of its file: a question has its scale. bodies: (mesh_count),
// zeroed.
static int encode_meshes(const problem_file *file, const nsvcd_encode_options *options,
                         encoded *bodies) {
  const char *slash = strrchr(file->path, '/');
  size_t folder = slash ? (size_t)(slash - file->path) + 1 : 0;
  for (size_t i = 0; i < file->mesh_count; i++) {
    const mesh_entry *mesh = &file->meshes[i];
    char from[1024], path[4096];
    snprintf(from, sizeof from, "%s:%zu: mesh %s: ", file->path, mesh->line, mesh->name);
    snprintf(path, sizeof path, "%.*s%s", mesh->path[0] == '/' ? 0 : (int)folder, file->path,
             mesh->path);
    bodies[i].body = encode_file(from, path, options, &bodies[i].seconds);
    if (!bodies[i].body)
      return 0;
  }
  return 1;
}

// ------------------------------------------------------------------------------------------- check

typedef struct check_options {
  nsvcd_encode_options encode;
  nsvcd_sweep_options sweep;
  size_t repeat;
  const char *path;
} check_options;

typedef struct outcome {  // of a problem
  nsvcd_answer answer;
  double microseconds;
} outcome;

typedef struct session {
  problem_file file;
  encoded *bodies;    // (file.mesh_count)
  outcome *outcomes;  // (file.problem_count)
} session;

// Answers one problem: once to warm up, then --repeat times by the clock. The shortest time counts:
// what is longer is the machine doing something else.
static int answer(const session *s, const check_options *options, void *workspace, const problem *p,
                  outcome *out) {
  nsvcd_question question = question_of_problem(&s->file, p);
  question.a.body = s->bodies[p->moving].body;
  question.b.body = s->bodies[p->fixed].body;
  question.options = options->sweep;
  out->microseconds = HUGE_VAL;
  for (size_t i = 0; i <= options->repeat; i++) {
    const double start = seconds();
    const nsvcd_result result =
        nsvcd_sweep(&question, workspace, nsvcd_sweep_workspace_size(NULL), &out->answer);
    const double taken = 1e6 * (seconds() - start);
    if (result)
      return complain("%s:%zu: problem %s: %s", s->file.path, p->line, p->id,
                      nsvcd_result_string(result));
    if (i > 0)
      out->microseconds = fmin(out->microseconds, taken);
  }
  return 1;
}

static int answer_all(session *s, const check_options *options) {
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  int good = 1;
  for (size_t i = 0; i < s->file.problem_count && good; i++) {
    good = answer(s, options, workspace, &s->file.problems[i], &s->outcomes[i]);
  }
  free(workspace);
  return good;
}

static int print_answers(const session *s) {
  for (size_t i = 0; i < s->file.problem_count; i++) {
    const nsvcd_answer *a = &s->outcomes[i].answer;
    printf("%s\t%.9g\t%d\t%.9g\t%lu\t%lu\t%s\t%.2f\n", s->file.problems[i].id, (double)a->logit,
           a->collides, (double)a->contact_time, (unsigned long)a->patch_a,
           (unsigned long)a->patch_b, nsvcd_status_string(a->status), s->outcomes[i].microseconds);
  }
  if (fflush(stdout) == 0 && !ferror(stdout))
    return 1;
  return complain("standard output: %s", strerror(errno));
}

// ----------------------------------------------------------------------------------------- summary

static void print_share(const char *name, size_t hits, size_t count, const char *of) {
  double low, high;
  if (!count)
    return;
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
  if (isnan(margin))
    return BANDS;
  while (fabs(margin) > band_edges[band])
    band++;
  return band;
}

// Counts by band (BANDS: no margin), truth and verdict.
typedef struct tally {
  size_t at[BANDS + 1][2][2];
} tally;

static size_t tally_sum(const tally *t, int label, int verdict) {
  size_t sum = 0;
  for (size_t band = 0; band <= BANDS; band++)
    sum += t->at[band][label][verdict];
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
    if (collide + clear == 0)
      continue;
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
    if (p->label >= 0)
      t.at[band_of(p->margin)][p->label][s->outcomes[i].answer.collides]++;
  }
  size_t missed = tally_sum(&t, 1, 0);
  size_t found = tally_sum(&t, 1, 1);
  size_t cleared = tally_sum(&t, 0, 0);
  size_t alarms = tally_sum(&t, 0, 1);
  if (missed + found + cleared + alarms == 0)
    return;
  print_share("accuracy", found + cleared, missed + found + cleared + alarms, "right");
  print_share("false negatives", missed, missed + found, "collisions missed");
  print_share("false positives", alarms, alarms + cleared, "free motions stopped");
  print_bands(&t);
}

static void print_statuses(const session *s) {
  fprintf(stderr, "\nstatus:");
  for (int status = NSVCD_STATUS_OK; status <= NSVCD_STATUS_UNDECIDED; status++) {
    size_t count = 0;
    for (size_t i = 0; i < s->file.problem_count; i++)
      count += (int)s->outcomes[i].answer.status == status;
    fprintf(stderr, "%s %s %.1f %%", status ? "," : "", nsvcd_status_string((nsvcd_status)status),
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
  if (!count)
    return;
  qsort(values, count, sizeof *values, compare_doubles);
  for (size_t i = 0; i < count; i++)
    sum += values[i];
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
  for (size_t i = 0; i < file->problem_count; i++)
    values[i] = s->outcomes[i].microseconds;
  print_distribution("a query", values, file->problem_count, "us");
  for (size_t i = 0; i < file->mesh_count; i++) {
    nsvcd_body_facts facts = nsvcd_body_describe(s->bodies[i].body);
    bytes += (double)facts.size / (double)file->mesh_count;
    points += (double)facts.patches / (double)file->mesh_count;
    values[i] = 1e3 * s->bodies[i].seconds;
  }
  print_distribution("encoding a mesh", values, file->mesh_count, "ms");
  if (file->mesh_count)
    fprintf(stderr, "a body: %.0f bytes, %.1f points (mean)\n", bytes, points);
  free(values);
}

static void print_summary(const session *s) {
  const problem_file *file = &s->file;
  size_t labels[3] = {0, 0, 0};  // -1, 0, 1
  for (size_t i = 0; i < file->problem_count; i++)
    labels[file->problems[i].label + 1]++;
  fprintf(stderr, "%s: %zu problems (%zu collide, %zu free, %zu without a label), %zu meshes\n",
          file->path, file->problem_count, labels[2], labels[1], labels[0], file->mesh_count);
  if (!file->problem_count)
    return;
  print_accuracy(s);
  print_statuses(s);
  print_costs(s);
}

// ------------------------------------------------------------------------------------ command line

static int usage(void) {
  fprintf(stderr,
          "svcd check [--method proof|network] [--points N] [--pairs K] [--model tiny|small|base] "
          "[--int8]\n"
          "           [--recall R] [--clearance METRES] [--first TOLERANCE] [--work LIMIT] "
          "[--repeat R] FILE\n"
          "    answers the problems of FILE, a line each on standard output, separated by tabs:\n"
          "    ID LOGIT COLLIDES TIME MOVING_PATCH FIXED_PATCH STATUS MICROSECONDS; a summary on "
          "standard error.\n"
          "      --method M   proof: a witness or a certificate; network: an opinion (proof)\n"
          "      --points N   representative points per body, 1..%d (%d; %d for the network)\n"
          "      --pairs K    pairs of patches that the network looks at, 1..%d (8)\n"
          "      --model M    decoder (base)\n"
          "      --recall R   share of collisions to be found: 0.99, 0.999, 0.9999 or 0: balanced "
          "errors (0)\n"
          "      --clearance METRES  to come as close as this is a collision (0: to meet is)\n"
          "      --first TOLERANCE   TIME is that of the first contact, to this share of the "
          "motion (0: of any contact)\n"
          "      --work LIMIT units that a proof may take (%d)\n"
          "      --repeat R   time every query R times, report the least (5)\n"
          "      --int8       the decoder in 8-bit integers\n"
          "svcd encode IN.obj OUT.body|OUT.h [--points N | --radius METRES] [--no-triangles | "
          "--no-latents | --latents]\n"
          "    encodes a mesh, to a file or to a C array; --radius: as many points as make patches "
          "of that radius;\n"
          "    --no-triangles: for the network alone; --no-latents: for the proof alone; "
          "--latents: for both, also where there\n"
          "    are more than %d points\n"
          "svcd info FILE.body\n"
          "exit status: 0 done, 1 a file or line was refused, 2 usage\n",
          NSVCD_MAX_PATCHES, NSVCD_DEFAULT_PATCHES, NSVCD_DEFAULT_NETWORK_PATCHES, NSVCD_MAX_PAIRS,
          NSVCD_DEFAULT_WORK, NSVCD_SMALL_PATCHES);
  return USAGE;
}
static int usage_error(const char *option, const char *reason) {
  complain("%s: %s", option, reason);
  return USAGE;
}

static int parse_model(const char *name, nsvcd_model *model) {
  static const char *const names[] = {"tiny", "small", "base"};
  for (int i = 0; i < 3; i++) {
    if (strcmp(name, names[i]) != 0)
      continue;
    *model = (nsvcd_model)(NSVCD_MODEL_TINY + i);
    return 1;
  }
  return 0;
}

static int parse_method(const char *name, nsvcd_method *method) {
  const int proof = strcmp(name, "proof") == 0;
  *method = proof ? NSVCD_METHOD_PROOF : NSVCD_METHOD_NETWORK;
  return proof || strcmp(name, "network") == 0;
}

static int parse_share(const char *text, float most, float *out) {
  return parse_float(text, out) && *out >= 0 && *out <= most;
}

// Returns DONE or USAGE.
static int parse_check_option(const char *key, const char *value, check_options *options) {
  if (strcmp(key, "--points") == 0)
    return parse_count(value, 1, NSVCD_MAX_PATCHES, &options->encode.patches)
               ? DONE
               : usage_error(key, "out of range");
  if (strcmp(key, "--pairs") == 0)
    return parse_count(value, 1, NSVCD_MAX_PAIRS, &options->sweep.pairs)
               ? DONE
               : usage_error(key, "out of range");
  if (strcmp(key, "--repeat") == 0)
    return parse_count(value, 1, 1000000, &options->repeat) ? DONE
                                                            : usage_error(key, "out of range");
  if (strcmp(key, "--model") == 0)
    return parse_model(value, &options->sweep.model)
               ? DONE
               : usage_error(key, "none of tiny, small, base");
  if (strcmp(key, "--recall") == 0)
    return parse_float(value, &options->sweep.recall) ? DONE : usage_error(key, "not a number");
  if (strcmp(key, "--clearance") == 0)
    return parse_share(value, NSVCD_MAX_COORDINATE, &options->sweep.clearance)
               ? DONE
               : usage_error(key, "out of range");
  if (strcmp(key, "--first") == 0)
    return parse_share(value, 1, &options->sweep.first) ? DONE : usage_error(key, "not in 0..1");
  if (strcmp(key, "--work") == 0)
    return parse_count(value, 1, 1000000000, &options->sweep.work)
               ? DONE
               : usage_error(key, "out of range");
  if (strcmp(key, "--method") == 0)
    return parse_method(value, &options->sweep.method)
               ? DONE
               : usage_error(key, "neither proof nor network");
  return usage_error(key, "no such option");
}

// The library knows which recalls it was calibrated for: ask it before any work is done. A body of
// one triangle serves.
static int recall_is_known(const nsvcd_sweep_options *options) {
  float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  uint32_t indices[3] = {0, 1, 2};
  nsvcd_mesh mesh = {positions, indices, 3, 1};
  nsvcd_encode_options one_point = {.patches = 1};
  const nsvcd_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd_answer unused;
  const nsvcd_body *body;
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  nsvcd_result result = nsvcd_encode(&mesh, &one_point, NULL, NULL, 0, &body);
  if (!result) {
    nsvcd_question question = {0};
    question.a.body = question.b.body = body;
    question.a.poses = &pose;
    question.a.count = 1;
    question.options = *options;
    result = nsvcd_sweep(&question, workspace, nsvcd_sweep_workspace_size(NULL), &unused);
    nsvcd_body_free(body, NULL);
  }
  free(workspace);
  return result == NSVCD_OK;
}

static int parse_check(int argc, char **argv, check_options *options) {
  memset(options, 0, sizeof *options);
  options->repeat = 5;
  for (int i = 0; i < argc; i++) {
    int status = DONE;
    if (strcmp(argv[i], "--int8") == 0) {
      options->sweep.precision = NSVCD_PRECISION_INT8;
      continue;
    }
    if (argv[i][0] != '-' && options->path)
      return usage_error(argv[i], "one problem file at a time");
    if (argv[i][0] != '-')
      options->path = argv[i];
    else if (i + 1 == argc)
      status = usage_error(argv[i], "a value is missing, or there is no such option");
    else {
      status = parse_check_option(argv[i], argv[i + 1], options);
      i++;
    }
    if (status != DONE)
      return status;
  }
  if (!options->path)
    return usage();
  options->encode.no_triangles = options->sweep.method == NSVCD_METHOD_NETWORK;
  if (options->encode.no_triangles && (options->sweep.clearance > 0 || options->sweep.first > 0)) {
    return usage_error("--method network", "it knows neither --clearance nor --first");
  }
  if (!recall_is_known(&options->sweep))
    return usage_error("--recall", "none of 0, 0.99, 0.999, 0.9999");
  return DONE;
}

static int check(int argc, char **argv) {
  check_options options;
  int status = parse_check(argc, argv, &options);
  if (status != DONE)
    return status;
  session s;
  memset(&s, 0, sizeof s);
  int good = read_problems(options.path, &s.file);
  if (good) {
    s.bodies = (encoded *)allocate(s.file.mesh_count * sizeof *s.bodies);
    s.outcomes = (outcome *)allocate(s.file.problem_count * sizeof *s.outcomes);
    memset(s.bodies, 0, s.file.mesh_count * sizeof *s.bodies);
  }
  good = good && encode_meshes(&s.file, &options.encode, s.bodies) && answer_all(&s, &options) &&
         print_answers(&s);
  if (good)
    print_summary(&s);
  for (size_t i = 0; s.bodies && i < s.file.mesh_count; i++)
    nsvcd_body_free(s.bodies[i].body, NULL);
  free(s.bodies);
  free(s.outcomes);
  free_problems(&s.file);
  return good ? DONE : REFUSED;
}

// --------------------------------------------------------------------------------- encode and info

static int ends_with(const char *text, const char *end) {
  size_t n = strlen(text);
  size_t m = strlen(end);
  return n >= m && strcmp(text + n - m, end) == 0;
}

// "parts/my-mug.h" -> "my_mug_body".
static void array_name(const char *path, char *name, size_t size) {
  const char *slash = strrchr(path, '/');
  const char *base = slash ? slash + 1 : path;
  int digit = isdigit((unsigned char)base[0]);  // no C name begins with one
  snprintf(name, size, "%s%.*s_body", digit ? "_" : "",
           (int)(strlen(base) < 40 ? strlen(base) - 2 : 40), base);
  for (char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c))
      *c = '_';
}

static void write_header(FILE *file, const char *in, const char *name, const nsvcd_body *body) {
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  const unsigned char *bytes = (const unsigned char *)body;
  fprintf(file,
          "// %s, encoded for neuralsvcd.h by `svcd encode`: %zu points. For %s-endian hosts.\n"
          "//   const nsvcd_body *body;\n"
          "//   nsvcd_result result = nsvcd_body_load(%s, sizeof %s, &body);\n"
          "#if defined(__cplusplus)\n"
          "alignas(%d)\n"
          "#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L\n"
          "_Alignas(%d)\n"
          "#elif defined(__GNUC__)\n"
          "__attribute__((aligned(%d)))\n"
          "#elif defined(_MSC_VER)\n"
          "__declspec(align(%d))\n"
          "#endif\n"
          "static const unsigned char %s[%zu] = {",
          in, facts.patches, bytes[0] == 'N' ? "little" : "big", name, name, NSVCD_ALIGNMENT,
          NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, NSVCD_ALIGNMENT, name, facts.size);
  for (size_t i = 0; i < facts.size; i++)
    fprintf(file, "%s%d,", i % 24 ? "" : "\n    ", bytes[i]);
  fprintf(file, "\n};\n");
}

static int write_body(const char *in, const char *out, const nsvcd_body *body) {
  int header = ends_with(out, ".h");
  int good;
  FILE *file = fopen(out, header ? "w" : "wb");
  if (!file)
    return complain("%s: %s", out, strerror(errno));
  if (header) {
    char name[64];
    array_name(out, name, sizeof name);
    write_header(file, in, name, body);
  } else {
    fwrite(body, 1, nsvcd_body_describe(body).size, file);
  }
  good = !ferror(file);
  if (fclose(file) != 0 || !good)
    return complain("%s: cannot be written", out);
  return 1;
}

static void print_facts(const char *path, const nsvcd_body *body) {
  nsvcd_body_facts facts = nsvcd_body_describe(body);
  float centre[3];
  float radius;
  float least = facts.radius;
  float most = 0;
  for (uint32_t i = 0; nsvcd_body_patch(body, i, centre, &radius); i++) {
    least = fminf(least, radius);
    most = fmaxf(most, radius);
  }
  printf("%s: %zu points, %zu bytes\n", path, facts.patches, facts.size);
  if (facts.triangles)
    printf("triangles: %zu, in %zu listings, within %g m\n", facts.triangles, facts.listed,
           (double)facts.quantum);
  printf("bounding sphere: centre %g %g %g, radius %g m\n", (double)facts.centre[0],
         (double)facts.centre[1], (double)facts.centre[2], (double)facts.radius);
  printf("patch radius: mean %g, least %g, most %g m\n", (double)facts.mean_patch_radius,
         (double)least, (double)most);
}

static int encode(int argc, char **argv) {
  const char *paths[2] = {NULL, NULL};
  nsvcd_encode_options options = {.patches = 0};
  int path_count = 0;
  for (int i = 0; i < argc; i++) {
    const char *value = i + 1 < argc ? argv[i + 1] : "";
    if (argv[i][0] != '-') {
      if (path_count == 2)
        return usage();
      paths[path_count++] = argv[i];
    } else if (strcmp(argv[i], "--no-triangles") == 0) {
      options.no_triangles = 1;
    } else if (strcmp(argv[i], "--no-latents") == 0) {
      options.no_latents = 1;
    } else if (strcmp(argv[i], "--latents") == 0) {
      options.latents = 1;
    } else if (strcmp(argv[i], "--points") == 0) {
      if (!parse_count(value, 1, NSVCD_MAX_PATCHES, &options.patches))
        return usage_error(argv[i], "out of range");
      i++;
    } else if (strcmp(argv[i], "--radius") == 0) {
      if (!parse_float(value, &options.patch_radius) || options.patch_radius <= 0)
        return usage_error(argv[i], "not a positive number of metres");
      i++;
    } else {
      return usage_error(argv[i], "no such option");
    }
  }
  if (path_count != 2)
    return usage();
  if (!ends_with(paths[1], ".body") && !ends_with(paths[1], ".h"))
    return usage_error(paths[1], "neither .body nor .h");
  if (options.no_triangles && options.no_latents)
    return usage_error("--no-latents", "nothing would be left");
  if (options.latents && options.no_latents)
    return usage_error("--latents", "not together with --no-latents");
  if (options.patches && options.patch_radius > 0)
    return usage_error("--radius", "not together with --points");

  double taken;
  const nsvcd_body *body = encode_file("", paths[0], &options, &taken);
  int good = body && write_body(paths[0], paths[1], body);
  if (good)
    print_facts(paths[1], body);
  if (good)
    printf("encoded in %.1f ms\n", 1e3 * taken);
  nsvcd_body_free(body, NULL);
  return good ? DONE : REFUSED;
}

// A blob begins with "NSVB", or, from a big-endian machine, with "BVSN".
static int has_other_byte_order(const char *memory, size_t size) {
  const uint16_t one = 1;
  const char *other = *(const char *)&one ? "BVSN" : "NSVB";
  return size >= 4 && memcmp(memory, other, 4) == 0;
}

static int info(int argc, char **argv) {
  if (argc != 1)
    return usage();
  size_t size;
  char *memory = read_file(argv[0], &size);
  if (!memory)
    return REFUSED;
  const nsvcd_body *body;
  nsvcd_result result = nsvcd_body_load(memory, size, &body);
  if (result)
    complain("%s: %s", argv[0],
             has_other_byte_order(memory, size) ? "encoded on a machine of the other byte order"
                                                : nsvcd_result_string(result));
  if (!result)
    print_facts(argv[0], body);
  free(memory);
  return result ? REFUSED : DONE;
}

int main(int argc, char **argv) {
  if (argc > 1 && strcmp(argv[1], "check") == 0)
    return check(argc - 2, argv + 2);
  if (argc > 1 && strcmp(argv[1], "encode") == 0)
    return encode(argc - 2, argv + 2);
  if (argc > 1 && strcmp(argv[1], "info") == 0)
    return info(argc - 2, argv + 2);
  return usage();
}
