// SPDX-License-Identifier: MIT
// svcd.c - neuralsvcd.h on the command line: does this body, moving so, hit that one? What is wrong
// with a mesh? Encodes meshes, and answers whole files of problems.
//
// `svcd --help` says how to use it, FORMATS.md what it reads and prints. Exit status: 0 done, 1 a
// file or a line was refused (file, line and reason on standard error), 2 usage.
#define _POSIX_C_SOURCE 200112L  // scenery/clock.h
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define PROGRAM "svcd"
#include "scenery/problem_file.h"
#include "scenery/status_of.h"
// these call problem_file.h's
#include "scenery/load.h"
#include "scenery/options.h"
#include "scenery/robot_file.h"
#include "scenery/problem_summary.h"
#include "scenery/sweep_motion.h"
// and these the oracle
#include "scenery/poses.h"
#include "scenery/sweep_picture.h"
#include "scenery/robot_picture.h"
#include "scenery/certificates.h"

// ---------------------------------------------------------------------------------------- settings

enum { CHECK = 1, ENCODE = 2, INFO = 4, SWEEP = 8, PLAN = 16, PATH = 32, PAIRS = 64 };
#define ALL (CHECK | ENCODE | INFO | SWEEP | PLAN | PATH | PAIRS)

typedef struct settings {  // of all commands
  nsvcd_encode_options encode;
  nsvcd_question sweep;  // what is asked, of whatever bodies
  float first[2];        // a share of the motion, or metres; 0: not asked for
  float measure;         // metres
  size_t repeat;
  const char *from, *to, *rotate, *scale, *picture, *film, *details, *only, *joints;
  const char *certificate, *certificates;
  size_t seed, samples;
  int int8, help;
  const char *paths[2];
  size_t path_count;
} settings;

#define AT(member) offsetof(settings, member)
#define POINTS NSVCD_MAX_PATCHES
#define METRES (double)NSVCD_MAX_COORDINATE
static const option options[] = {
    {"--help", ALL, OPTION_FLAG, AT(help), 0, 0, NULL},
    {"-h", ALL, OPTION_FLAG, AT(help), 0, 0, NULL},
    {"--scale", ENCODE | INFO | SWEEP, OPTION_TEXT, AT(scale), 0, 0, NULL},
    {"--from", SWEEP, OPTION_TEXT, AT(from), 0, 0, NULL},
    {"--to", SWEEP, OPTION_TEXT, AT(to), 0, 0, NULL},
    {"--rotate", SWEEP, OPTION_TEXT, AT(rotate), 0, 0, NULL},
    {"--picture", SWEEP | PLAN, OPTION_TEXT, AT(picture), 0, 0, NULL},
    {"--film", PLAN, OPTION_TEXT, AT(film), 0, 0, NULL},
    {"--measure", SWEEP, OPTION_NUMBER, AT(measure), 1e-9, METRES, "NSVCD_MAX_COORDINATE"},
    {"--skin", CHECK | SWEEP, OPTION_NUMBER, AT(sweep.skin), 0, METRES, "NSVCD_MAX_COORDINATE"},
    {"--clearance", CHECK | SWEEP | PLAN | PATH, OPTION_NUMBER, AT(sweep.clearance), 0, METRES,
     "NSVCD_MAX_COORDINATE"},
    {"--first", CHECK | SWEEP, OPTION_LENGTH, AT(first), 0, 1, "or metres: 0.001m"},
    {"--details", CHECK, OPTION_TEXT, AT(details), 0, 0, NULL},
    {"--certificates", CHECK | PLAN, OPTION_TEXT, AT(certificates), 0, 0, NULL},
    {"--certificate", SWEEP, OPTION_TEXT, AT(certificate), 0, 0, NULL},
    {"--method", CHECK | SWEEP, OPTION_WORD, AT(sweep.method), NSVCD_METHOD_PROOF, 0,
     "proof|network"},
    {"--points", CHECK | ENCODE | SWEEP, OPTION_COUNT, AT(encode.patches), 1, POINTS,
     "NSVCD_MAX_PATCHES"},
    {"--radius", ENCODE, OPTION_NUMBER, AT(encode.patch_radius), 1e-12, METRES,
     "NSVCD_MAX_COORDINATE"},
    {"--no-triangles", ENCODE, OPTION_FLAG, AT(encode.no_triangles), 0, 0, NULL},
    {"--latents", ENCODE, OPTION_FLAG, AT(encode.latents), 0, 0, NULL},
    {"--pairs", CHECK, OPTION_COUNT, AT(sweep.network.pairs), 1, NSVCD_MAX_PAIRS,
     "NSVCD_MAX_PAIRS"},
    {"--model", CHECK, OPTION_WORD, AT(sweep.network.model), NSVCD_MODEL_TINY, 0,
     "tiny|small|base"},
    {"--recall", CHECK, OPTION_NUMBER, AT(sweep.network.recall), 0, 1, NULL},
    {"--int8", CHECK, OPTION_FLAG, AT(int8), 0, 0, NULL},
    {"--work", CHECK | SWEEP, OPTION_COUNT, AT(sweep.work), 1, 1000000000, NULL},
    {"--repeat", CHECK | SWEEP, OPTION_COUNT, AT(repeat), 1, 1000000, NULL},
    {"--seed", PLAN | PAIRS, OPTION_COUNT, AT(seed), 0, 1000000000, NULL},
    {"--only", PLAN | PATH, OPTION_TEXT, AT(only), 0, 0, NULL},
    {"--samples", PLAN, OPTION_COUNT, AT(samples), 2, 10000000, NULL},
    {"--joints", PLAN, OPTION_TEXT, AT(joints), 0, 0, NULL},
};
#define OPTION_COUNT_OF (sizeof options / sizeof options[0])

static int usage_error(const char *what, const char *reason) {
  complain("%s: %s", what, reason);
  return USAGE;
}

// ------------------------------------------------------------------------------------------- check

// Every mesh once, in the units of its file: a question has its scale. bodies: (mesh_count),
// zeroed.
static int encode_meshes(const problem_file *file, const nsvcd_encode_options *options,
                         encoded *bodies) {
  for (size_t i = 0; i < file->mesh_count; i++) {
    const mesh_entry *mesh = &file->meshes[i];
    char from[1024];
    snprintf(from, sizeof from, "%s:%zu: mesh %s: ", file->path, mesh->line, mesh->name);
    bodies[i].body = encode_named(from, file->path, mesh->path, options, &bodies[i].seconds);
    if (!bodies[i].body) return 0;
  }
  return 1;
}

// Is a contact known, but not whether it is the first one, if that was asked for? Surfaces that come
// nearer than triangles are stored can hide that.
static int hides_first(const nsvcd_answer *answer) {
  return answer->verdict == NSVCD_HIT && answer->why != NSVCD_WHY_NOTHING;
}

// Asks for the first contact, to a share of the motion or to metres, or, if both are 0, for any.
static int wants_first(const settings *options) {
  return options->first[0] > 0 || options->first[1] > 0;
}
static void ask_first(nsvcd_question *question, const settings *options) {
  question->ask = wants_first(options) ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
  question->to_time = options->first[0];
  question->to = options->first[1];
}

// Answers one problem: once to warm up, then --repeat times by the clock. The shortest time counts:
// what is longer is the machine doing something else.
static int answer(const session *s, const settings *options, void *workspace, const problem *p,
                  outcome *out) {
  const nsvcd_question movers = question_of_problem(&s->file, p);
  nsvcd_question question = options->sweep;
  question.a = movers.a;
  question.b = movers.b;
  question.a.body = s->bodies[p->moving].body;
  question.b.body = s->bodies[p->fixed].body;
  ask_first(&question, options);
  question.manifold = options->details && wants_first(options);
  out->microseconds = HUGE_VAL;
  for (size_t i = 0; i <= options->repeat; i++) {
    const double start = seconds();
    const nsvcd_result result =
        nsvcd_sweep(&question, workspace, nsvcd_sweep_workspace_size(NULL), &out->answer);
    const double taken = 1e6 * (seconds() - start);
    if (result)
      return complain("%s:%zu: problem %s: %s", s->file.path, p->line, p->id, reason_of(result));
    if (i > 0) out->microseconds = fmin(out->microseconds, taken);
  }
  return 1;
}

static int answer_all(session *s, const settings *options) {
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
    uint32_t patch_a, patch_b;
    patches_of(a, &patch_a, &patch_b);
    printf("%s\t%.9g\t%d\t%.9g\t%lu\t%lu\t%s\t%.2f\n", s->file.problems[i].id, (double)logit_of(a),
           collides_of(a), (double)contact_time_of(a), (unsigned long)patch_a,
           (unsigned long)patch_b, status_string(hides_first(a) ? STATUS_UNDECIDED : status_of(a)),
           s->outcomes[i].microseconds);
  }
  if (fflush(stdout) == 0 && !ferror(stdout)) return 1;
  return complain("standard output: %s", strerror(errno));
}

// What is not known is no number.
static void print_numbers(FILE *out, const float *numbers, size_t count) {
  for (size_t k = 0; k < count; k++) {
    if (isinf(numbers[k])) fprintf(out, "\tnan");
    if (!isinf(numbers[k])) fprintf(out, "\t%.9g", (double)numbers[k]);
  }
}

// All that an answer says, a line a problem.
static int write_details(const session *s, const char *path) {
  FILE *out = fopen(path, "w");
  if (!out) return complain("%s: %s", path, strerror(errno));
  for (size_t i = 0; i < s->file.problem_count; i++) {
    const nsvcd_answer *a = &s->outcomes[i].answer;
    const float known[6] = {a->time.low,      a->time.high, a->distance.low,
                            a->distance.high, a->depth,     a->safe.time};
    fprintf(out, "%s\t%s", s->file.problems[i].id, nsvcd_verdict_string(a->verdict));
    print_numbers(out, known, 6);
    print_numbers(out, a->safe.a.position, 3);
    print_numbers(out, a->safe.a.rotation, 4);
    fprintf(out, "\t%zu", a->contact_count);
    for (size_t n = 0; n < a->contact_count; n++) {
      print_numbers(out, a->contacts[n].point, 3);
      print_numbers(out, a->contacts[n].normal, 3);
      print_numbers(out, &a->contacts[n].gap, 1);
    }
    fprintf(out, "\n");
  }
  return close_written(out, path);
}

// The library knows which recalls it was calibrated for: ask it before any work is done. A body of
// one triangle serves.
static int recall_is_known(const nsvcd_question *asked) {
  float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  uint32_t indices[3] = {0, 1, 2};
  nsvcd_mesh mesh = {positions, indices, 3, 1};
  nsvcd_encode_options one_point = {.patches = 1, .latents = 1};
  const nsvcd_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd_answer unused;
  const nsvcd_body *body;
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  nsvcd_result result = nsvcd_encode(&mesh, &one_point, NULL, NULL, 0, &body);
  if (!result) {
    nsvcd_question question = *asked;
    question.a.body = question.b.body = body;
    question.a.poses = &pose;
    question.a.count = 1;
    result = nsvcd_sweep(&question, workspace, nsvcd_sweep_workspace_size(NULL), &unused);
    nsvcd_body_free(body, NULL);
  }
  free(workspace);
  return result == NSVCD_OK;
}

static int check_options(settings *options) {
  nsvcd_question *sweep = &options->sweep;
  if (options->path_count != 1)
    return usage_error("check", "a problem file is wanted ('svcd check --help')");
  if (options->int8) sweep->network.precision = NSVCD_PRECISION_INT8;
  options->encode.no_triangles = sweep->method == NSVCD_METHOD_NETWORK;
  if (options->encode.no_triangles &&
      (sweep->clearance > 0 || wants_first(options) || sweep->skin > 0))
    return usage_error("--method network", "it knows neither --clearance, --first nor --skin");
  if (options->details && !ends_with(options->details, ".tsv"))
    return usage_error("--details", "a file that ends in .tsv is wanted");
  if (options->certificates && (options->encode.no_triangles || sweep->skin > 0))
    return usage_error("--certificates", "not with --method network, nor with --skin");
  if (!recall_is_known(sweep)) return usage_error("--recall", "none of 0, 0.99, 0.999, 0.9999");
  return DONE;
}

static int check(settings *options) {
  const int status = check_options(options);
  if (status != DONE) return status;
  session s;
  memset(&s, 0, sizeof s);
  int good = read_problems(options->paths[0], &s.file);
  if (good) {
    s.bodies = (encoded *)allocate(s.file.mesh_count * sizeof *s.bodies);
    s.outcomes = (outcome *)allocate(s.file.problem_count * sizeof *s.outcomes);
    memset(s.bodies, 0, s.file.mesh_count * sizeof *s.bodies);
  }
  good = good && encode_meshes(&s.file, &options->encode, s.bodies) && answer_all(&s, options) &&
         (!options->details || write_details(&s, options->details)) && print_answers(&s) &&
         (!options->certificates ||
          write_certificates(&s, options->certificates, options->sweep.clearance));
  if (good) print_summary(&s);
  for (size_t i = 0; s.bodies && i < s.file.mesh_count; i++)
    nsvcd_body_free(s.bodies[i].body, NULL);
  free(s.bodies);
  free(s.outcomes);
  free_problems(&s.file);
  return good ? DONE : REFUSED;
}

// --------------------------------------------------------------------------------- encode and info

// "parts/my-mug.h" -> "my_mug_body".
static void array_name(const char *path, char *name, size_t size) {
  const char *base = file_name(path);
  int digit = isdigit((unsigned char)base[0]);  // no C name begins with one
  snprintf(name, size, "%s%.*s_body", digit ? "_" : "",
           (int)(strlen(base) < 40 ? strlen(base) - 2 : 40), base);
  for (char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c)) *c = '_';
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
  for (size_t i = 0; i < facts.size; i++) fprintf(file, "%s%d,", i % 24 ? "" : "\n    ", bytes[i]);
  fprintf(file, "\n};\n");
}

// May a body be written there? Not over what is there and is none: it may be the input, by whatever
// name. Returns 0 after a complaint.
static int may_write_body(const char *path) {
  char begin[5000] = "";
  FILE *file = fopen(path, "rb");
  const size_t size = file ? fread(begin, 1, sizeof begin - 1, file) : 0;
  if (file) fclose(file);
  const int is_blob = memcmp(begin, "NSVB", 4) == 0 || memcmp(begin, "BVSN", 4) == 0;
  const int is_array =
      memcmp(begin, "// ", 3) == 0 && strstr(begin, "encoded for neuralsvcd.h by") != NULL;
  if (size == 0 || (ends_with(path, ".h") ? is_array : is_blob)) return 1;
  return complain("%s: is there already, and is no body", path);
}

static int write_body(const char *in, const char *out, const nsvcd_body *body) {
  int header = ends_with(out, ".h");
  FILE *file = fopen(out, header ? "w" : "wb");
  if (!file) return complain("%s: %s", out, strerror(errno));
  if (header) {
    char name[64];
    array_name(out, name, sizeof name);
    write_header(file, in, name, body);
  } else {
    fwrite(body, 1, nsvcd_body_describe(body).size, file);
  }
  return close_written(file, out);
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
    printf("triangles: %zu, in %zu listings, within %g m\n", facts.triangles, facts.listings,
           (double)facts.quantum);
  printf("bounding sphere: centre %g %g %g, radius %g m\n", (double)facts.centre[0],
         (double)facts.centre[1], (double)facts.centre[2], (double)facts.radius);
  printf("patch radius: mean %g, least %g, most %g m\n", (double)facts.mean_patch_radius,
         (double)least, (double)most);
}

static int encode_options(const settings *options) {
  const nsvcd_encode_options *encode = &options->encode;
  if (options->path_count != 2)
    return usage_error("encode", "IN.obj and OUT.body or OUT.h are wanted ('svcd encode --help')");
  if (!ends_with(options->paths[1], ".body") && !ends_with(options->paths[1], ".h"))
    return usage_error(options->paths[1], "neither .body nor .h");
  if (encode->patches && encode->patch_radius > 0)
    return usage_error("--radius", "not together with --points");
  return DONE;
}

static int encode(settings *options) {
  const char *out = options->paths[1];
  const int status = encode_options(options);
  float scales[2];
  thing t;
  if (status != DONE || !take_scales(options->scale, 1, scales)) return USAGE;
  if (!may_write_body(out)) return REFUSED;
  const int good = load_obj(options->paths[0], scales[0], &t) &&
                   encode_thing(&t, &options->encode) && write_body(t.path, out, t.body);
  if (good) {
    warn_of(&t, t.fault_count);
    print_facts(out, t.body);
    printf("encoded in %.1f ms\n", 1e3 * t.taken);
  }
  free_thing(&t);
  return good ? DONE : REFUSED;
}

static void print_mesh(const thing *t) {
  const mesh_report *r = &t->report;
  printf("%s: an %s: %zu triangle%s, %zu vertices\n", t->path, is_stl(t->path) ? "STL" : "OBJ",
         r->triangles, r->triangles == 1 ? "" : "s", r->vertices);
  printf("box: %.4g x %.4g x %.4g m, from %.4g %.4g %.4g to %.4g %.4g %.4g\n",
         r->high[0] - r->low[0], r->high[1] - r->low[1], r->high[2] - r->low[2], r->low[0],
         r->low[1], r->low[2], r->high[0], r->high[1], r->high[2]);
  printf("components: %zu, %zu of them closed", r->components, r->closed);
  if (r->inwards) printf(", %zu of these turned inwards: cavities, or inside out", r->inwards);
  printf("\narea: %.4g m2", r->area);
  if (r->closed) printf(", volume of what is closed: %.4g m3", r->volume);
  printf("\n");
}

static int info_of_mesh(const settings *options) {
  const nsvcd_encode_options defaults = {.patches = 0};
  float scales[2];
  thing t;
  if (!take_scales(options->scale, 1, scales)) return USAGE;
  int good = load_obj(options->paths[0], scales[0], &t);
  if (good) {
    print_mesh(&t);
    fflush(stdout);
    good = encode_thing(&t, &defaults);
    for (int i = 0; i < t.fault_count; i++) printf("wrong: %s\n", t.faults[i]);
    if (good && !t.fault_count) printf("nothing is wrong with it\n");
  }
  if (good) print_facts("as a body", t.body);
  free_thing(&t);
  return good ? DONE : REFUSED;
}

static int info(settings *options) {
  thing t;
  if (options->path_count != 1)
    return usage_error("info", "an OBJ or a .body file is wanted ('svcd info --help')");
  if (!is_body_file(options->paths[0])) return info_of_mesh(options);
  if (options->scale) return usage_error("--scale", "of an OBJ; a .body file is in metres");
  const int good = load_body(options->paths[0], 1, &t);
  if (good) print_facts(t.path, t.body);
  free_thing(&t);
  return good ? DONE : REFUSED;
}

// ------------------------------------------------------------------------------------ plan and path

#define PLAN_NODES 100000

// Is an ID one of a list "a,b"? NULL: all are.
static int is_listed(const char *list, const char *id) {
  const size_t length = strlen(id);
  while (list && *list) {
    const size_t word = strcspn(list, ",");
    if (word == length && strncmp(list, id, word) == 0) return 1;
    list += word + (list[word] == ',');
  }
  return !list;
}

static int plan_options(const settings *options, const char *command) {
  if (options->path_count != 1)
    return usage_error(command, "a planning file is wanted ('svcd plan --help')");
  if ((options->samples > 0) != (options->joints != NULL))
    return usage_error("--samples", "together with --joints OUT.tsv");
  if (options->joints && !ends_with(options->joints, ".tsv"))
    return usage_error("--joints", "a file that ends in .tsv is wanted");
  const char *pictures[2] = {options->picture, options->film};
  for (size_t k = 0; k < 2; k++) {
    const char *name = k ? "--film" : "--picture";
    if (!pictures[k]) continue;
    if (!ends_with(pictures[k], ".svg"))
      return usage_error(name, "a file that ends in .svg is wanted");
    if (!options->only || strchr(options->only, ',')) return usage_error(name, "--only one plan");
    if (!draw_may_write(pictures[k])) return REFUSED;
  }
  return DONE;
}

// How far the joints go, radians and metres alike: their ways added up as in space.
static double route_length(const nsvcd_joint_motion *m, size_t joints) {
  double length = 0;
  double q[2][NSVCD_MAX_JOINTS];
  const size_t looks = 16 * m->pieces;
  nsvcd_motion_at(m, joints, 0, q[0]);
  for (size_t k = 1; k <= looks; k++) {
    double sum = 0;
    const double *times = m->times + (k - 1) / 16;
    nsvcd_motion_at(m, joints, times[0] + (times[1] - times[0]) * (double)((k - 1) % 16 + 1) / 16,
                    q[k % 2]);
    for (size_t j = 0; j < joints; j++) sum += (q[1][j] - q[0][j]) * (q[1][j] - q[0][j]);
    length += sqrt(sum);
  }
  return length;
}

// All pairs that are as near as the clearance, and the nearest place that was found to be free, on
// standard error.
static void tell_way_out(const robot_in_room *in, const char *from, const double *joints,
                         float clearance) {
  nsvcd_gap_options options;
  nsvcd_escape_options escape;
  size_t count = 0;
  int is_found = 0;
  double out[NSVCD_MAX_JOINTS];
  nsvcd_gap *gaps = (nsvcd_gap *)allocate((in->scene.pair_count + 1) * sizeof *gaps);
  memset(&options, 0, sizeof options);
  memset(&escape, 0, sizeof escape);
  options.within = clearance > 0 ? clearance : 1e-6f;
  options.deepest = 0.1f;
  escape.clearance = clearance;
  if (nsvcd_gaps(in->checker, joints, &options, gaps, in->scene.pair_count, &count)) count = 0;
  for (size_t k = 0; k < count; k++) {
    const nsvcd_gap *gap = &gaps[k];
    const nsvcd_body_pair *pair = &in->scene.pairs[gap->pair];
    const char *a = robot_name(in, pair->a);
    const char *b = robot_name(in, pair->b);
    if (gap->verdict != NSVCD_HIT)
      complain("%s: %s and %s are %.2f mm apart", from, a, b, 1e3 * (double)gap->distance.high);
    else if (gap->depth < HUGE_VALF)
      complain("%s: %s and %s meet, %.2f mm deep", from, a, b, 1e3 * (double)gap->depth);
    else
      complain("%s: %s and %s meet, no lift of 100 mm parts them", from, a, b);
  }
  if (!nsvcd_escape(in->checker, joints, &escape, out, &is_found) && is_found) {
    char list[32 * NSVCD_MAX_JOINTS] = "";
    for (size_t j = 0; j < in->file->joint_count; j++)
      snprintf(list + strlen(list), sizeof list - strlen(list), " %.9g", out[j]);
    complain("%s: free near by:%s", from, list);
  } else {
    complain("%s: nothing free was found near by", from);
  }
  free(gaps);
}

// What is wrong with a start or a goal, on standard error.
static void tell_check(const robot_in_room *in, const robot_task *task, const char *where,
                       const double *joints, const nsvcd_check_answer *found, float clearance) {
  char from[1024];
  snprintf(from, sizeof from, "%s:%zu: %s: %s", in->file->path, task->line, task->id, where);
  if (found->joint != NSVCD_NONE) {
    complain("%s: joint %s is out of its limits", from, in->file->joint_names[found->joint]);
  } else if (found->verdict == NSVCD_UNDECIDED && found->pair != NSVCD_NONE) {
    const nsvcd_body_pair *pair = &in->scene.pairs[found->pair];
    complain("%s: %s and %s are too near each other to tell", from, robot_name(in, pair->a),
             robot_name(in, pair->b));
  }
  tell_way_out(in, from, joints, clearance);
}

static const char *plan_word(const nsvcd_route_answer *answer) {
  const int is_doubt =
      answer->check.verdict == NSVCD_UNDECIDED && answer->check.joint == NSVCD_NONE;
  if (answer->status == NSVCD_ROUTE_FOUND) return "certified";
  if (answer->status == NSVCD_ROUTE_START) return is_doubt ? "undecided" : "start";
  if (answer->status == NSVCD_ROUTE_GOAL) return is_doubt ? "undecided" : "goal";
  return "limit";
}

static int plan_one(const robot_in_room *in, const robot_task *task, const settings *options,
                    FILE *out) {
  nsvcd_route_problem problem;
  nsvcd_route_options asked;
  nsvcd_route_answer answer;
  int good = 1;
  const size_t joints = in->file->joint_count;
  memset(&problem, 0, sizeof problem);
  memset(&asked, 0, sizeof asked);
  problem.start = in->file->numbers + task->first;
  problem.goals = problem.start + joints;
  problem.goal_count = 1;
  asked.seed = options->seed;
  asked.clearance = options->sweep.clearance;
  asked.nodes = PLAN_NODES;
  const size_t size = nsvcd_route_size(in->checker, &problem, &asked);
  void *memory = allocate(size);
  const double began = seconds();
  const nsvcd_result result = nsvcd_route(in->checker, &problem, &asked, memory, size, &answer);
  const double taken = seconds() - began;
  if (!result) {
    const nsvcd_joint_motion *m = &answer.motion;
    const int is_found = answer.status == NSVCD_ROUTE_FOUND;
    printf("%s\t%s\t%.6f\t", task->id, plan_word(&answer), taken);
    if (is_found)
      printf("%.9g\t%.9g\n", answer.duration, route_length(m, joints));
    else
      printf("nan\tnan\n");
    if (answer.status == NSVCD_ROUTE_START)
      tell_check(in, task, "the start", problem.start, &answer.check, asked.clearance);
    if (answer.status == NSVCD_ROUTE_GOAL)
      tell_check(in, task, "the goal", problem.goals, &answer.check, asked.clearance);
    for (size_t k = 0; is_found && k < options->samples; k++) {
      double q[NSVCD_MAX_JOINTS];
      nsvcd_motion_at(m, joints, answer.duration * (double)k / (double)(options->samples - 1), q);
      fprintf(out, "%s\t%zu", task->id, k);
      for (size_t j = 0; j < joints; j++) fprintf(out, "\t%.17g", q[j]);
      fprintf(out, "\n");
    }
    if (is_found && options->picture) good = robot_draw(options->picture, 0, in, task->id, m);
    if (is_found && options->certificates)
      good = write_motion_proof(in, options->certificates, task->id, m, asked.clearance);
    if (is_found && options->film) good &= robot_draw(options->film, 1, in, task->id, m);
  }
  free(memory);
  if (result) complain("%s:%zu: %s: %s", in->file->path, task->line, task->id, reason_of(result));
  return !result && good;
}

// Edge by edge.
static int path_one(const robot_in_room *in, const robot_task *task, const settings *options,
                    FILE *out) {
  nsvcd_check_options asked;
  nsvcd_check_answer answer;
  nsvcd_result result = NSVCD_OK;
  const size_t joints = in->file->joint_count;
  const size_t edges = task->points > 1 ? task->points - 1 : 1;
  size_t edge = 0;
  memset(&asked, 0, sizeof asked);
  memset(&answer, 0, sizeof answer);
  asked.clearance = options->sweep.clearance;
  (void)out;
  const double began = seconds();
  for (size_t k = 0; k < edges && !result; k++) {
    const double *points = in->file->numbers + task->first + k * joints;
    const nsvcd_joint_motion motion = {task->points > 1, 1, points, NULL};
    edge = k;
    result = nsvcd_check(in->checker, &motion, &asked, &answer);
    if (answer.verdict != NSVCD_FREE) break;
  }
  const double mean = 1e6 * (seconds() - began) / (double)(edge + 1);
  if (result)
    return complain("%s:%zu: %s: %s", in->file->path, task->line, task->id, reason_of(result));
  printf("%s\t%s", task->id, nsvcd_verdict_string(answer.verdict));
  if (answer.verdict == NSVCD_FREE) {
    printf("\t-1\tnan\t-\t-");
  } else if (answer.pair == NSVCD_NONE) {
    printf("\t%zu\t%.9g\t-\t-", edge, answer.share);
  } else {
    const nsvcd_body_pair *pair = &in->scene.pairs[answer.pair];
    printf("\t%zu\t%.9g\t%s\t%s", edge, answer.share, robot_name(in, pair->a),
           robot_name(in, pair->b));
  }
  printf("\t%.2f\n", mean);
  return 1;
}

// Plans, or paths, one after another. A checker is opened where the scene is another one.
static int robot_tasks(const robot_file *file, const settings *options, int is_path, FILE *out) {
  robot_in_room in;
  int good = 1;
  memset(&in, 0, sizeof in);
  for (size_t i = 0; i < file->task_count && good; i++) {
    const robot_task *task = &file->tasks[i];
    if ((task->points > 0) != is_path || !is_listed(options->only, task->id)) continue;
    // a plan does not depend on those before: a checker remembers what was hit
    if (!is_path || in.room != &file->rooms[task->room]) good = enter_room(file, task->room, &in);
    if (good) good = (is_path ? path_one : plan_one)(&in, task, options, out);
  }
  leave_room(&in);
  return good;
}

// Which bodies of a robot can meet each other: lines for its planning file.
static int pairs(settings *options) {
  robot_file file;
  robot_in_room in;
  nsvcd_pair_counts counts;
  double taken;
  const int status = plan_options(options, "pairs");
  if (status != DONE) return status;
  memset(&in, 0, sizeof in);
  int good = read_robot(options->paths[0], &file);
  if (good && file.body_count == 0) good = complain("%s: no body", file.path);
  good = good && encode_robot(&file, &taken);
  if (good) {
    const size_t most = file.body_count * file.body_count;
    nsvcd_body_pair *found = (nsvcd_body_pair *)allocate(most * sizeof *found);
    good = enter_room(&file, NSVCD_NONE, &in);
    const nsvcd_result result =
        good ? nsvcd_find_pairs(in.checker, 0, options->seed, found, most, &counts) : NSVCD_OK;
    if (result) good = complain("%s: %s", file.path, reason_of(result));
    const size_t total = good ? counts.asked + counts.adjacent + counts.touching : 0;
    for (size_t n = 0; n < total; n++) {
      const char *word = n < counts.asked                     ? "pair"
                         : n < counts.asked + counts.adjacent ? "# adjacent:"
                                                              : "# always touching:";
      printf("%s %s %s\n", word, robot_name(&in, found[n].a), robot_name(&in, found[n].b));
    }
    free(found);
  }
  leave_room(&in);
  free_robot(&file);
  return good ? DONE : REFUSED;
}

static int robot_command(settings *options, int is_path) {
  robot_file file;
  double taken;
  FILE *out = NULL;
  const int status = plan_options(options, is_path ? "path" : "plan");
  if (status != DONE) return status;
  int good = read_robot(options->paths[0], &file);
  good = good && encode_robot(&file, &taken);
  if (good)
    fprintf(stderr, PROGRAM ": %zu meshes encoded in %.1f ms\n", file.mesh_count, 1e3 * taken);
  if (good && (options->picture || options->film) && file.body_count == 0)
    good = complain("%s: no body to draw", file.path);
  if (good && options->joints) {
    out = fopen(options->joints, "w");
    if (!out) good = complain("%s: %s", options->joints, strerror(errno));
  }
  good = good && robot_tasks(&file, options, is_path, out);
  if (out) {
    good = close_written(out, options->joints) && good;
  }
  free_robot(&file);
  return good ? DONE : REFUSED;
}
static int plan(settings *options) {
  return robot_command(options, 0);
}
static int path(settings *options) {
  return robot_command(options, 1);
}

// ------------------------------------------------------------------------------------------- sweep

typedef struct sweep_job {
  thing a, b;  // a moves
  motion motion;
  nsvcd_pose poses[MOST_POSES];
  nsvcd_question question;
  int by_proof;
  void *workspace;
  nsvcd_answer answer;
  nsvcd_answer nearest;       // where --measure asks for it and they are free of each other
  double microseconds;        // median, to know whether they meet
  double microseconds_first;  // and when
} sweep_job;

// The network answers where a body holds no triangles: then nothing may be asked that it does not
// know. Returns a status.
static int sweep_method(sweep_job *job, settings *options) {
  const nsvcd_question *sweep = &options->sweep;
  const thing *bare = nsvcd_body_describe(job->a.body).triangles ? &job->b : &job->a;
  const int proof = sweep->method != NSVCD_METHOD_NETWORK;
  job->by_proof = proof && nsvcd_body_describe(bare->body).triangles;
  if (job->by_proof) return DONE;
  if (sweep->method == NSVCD_METHOD_PROOF) {
    complain("%s: it holds no triangles, and so there is no proof", bare->path);
    return REFUSED;
  }
  if (sweep->clearance > 0 || options->measure > 0 || sweep->skin > 0) {
    complain("%s: the network knows neither --clearance, --measure nor --skin",
             proof ? bare->path : "--method network");
    return proof ? REFUSED : USAGE;
  }
  for (int i = 0; i < 2; i++) {
    const thing *t = i ? &job->b : &job->a;
    if (!nsvcd_body_describe(t->body).latents) {
      complain("%s: it holds nothing for the network", t->path);
      return REFUSED;
    }
  }
  options->first[0] = options->first[1] = 0;
  return DONE;
}

// Returns 0 after a complaint.
static int sweep_once(sweep_job *job, nsvcd_answer *answer) {
  const nsvcd_result result =
      nsvcd_sweep(&job->question, job->workspace, nsvcd_sweep_workspace_size(NULL), answer);
  return result ? complain("%s", reason_of(result)) : 1;
}

// Once to warm up, and then by the clock: the median, in microseconds. Negative after a complaint.
static double sweep_timed(sweep_job *job, size_t repeat, nsvcd_answer *answer) {
  double *times = (double *)allocate(repeat * sizeof *times);
  int good = sweep_once(job, answer);
  for (size_t i = 0; good && i < repeat; i++) {
    const double start = seconds();
    good = sweep_once(job, answer);
    times[i] = 1e6 * (seconds() - start);
  }
  if (good) qsort(times, repeat, sizeof *times, compare_doubles);
  const double median = good ? (times[(repeat - 1) / 2] + times[repeat / 2]) / 2 : -1;
  free(times);
  return median;
}

// The answer, and, where they are free of each other, how near they come.
static int sweep_ask(sweep_job *job, const settings *options) {
  nsvcd_question *question = &job->question;
  *question = options->sweep;
  question->a.body = job->a.body;
  question->a.poses = job->poses;
  question->a.count = job->motion.count;
  question->a.scale = job->a.scale;
  question->b.body = job->b.body;
  question->b.scale = job->b.scale;
  for (size_t i = 0; i < job->motion.count; i++)
    job->poses[i] = pose_rounded(&job->motion.poses[i]);
  job->microseconds = sweep_timed(job, options->repeat, &job->answer);
  if (job->microseconds < 0) return 0;
  if (job->answer.verdict != NSVCD_FREE && wants_first(options)) {
    ask_first(question, options);
    job->microseconds_first = sweep_timed(job, options->repeat, &job->answer);
  }
  if (!(options->measure > 0) || collides_of(&job->answer)) return job->microseconds_first >= 0;
  question->clearance = question->to_time = 0;
  question->ask = NSVCD_ASK_DISTANCE;
  question->to = options->measure;
  return sweep_once(job, &job->nearest);
}

// How it was decided.
static void sweep_reason(const sweep_job *job, const settings *options, char *out, size_t size) {
  const int proof = job->by_proof;
  const char *reason = "the network's opinion";
  const status s = status_of(&job->answer);
  if (s == STATUS_WITNESS)
    reason = options->sweep.clearance > 0 ? "proven, two triangles come so near"
                                          : "proven, two triangles meet";
  if (s == STATUS_CERTIFIED_FREE)
    reason = proof ? "proven, the surfaces never meet" : "proven, spheres about them never meet";
  if (s == STATUS_INSIDE)
    reason = proof ? "proven, one is inside of the other at the start"
                   : "estimated, one is inside of the other at the start";
  if (s == STATUS_UNDECIDED)
    reason = "nearer than triangles are stored, or more work than --work allows";
  snprintf(out, size, "%s", reason);
  if (job->answer.by == NSVCD_BY_NETWORK && !job->answer.inside)
    snprintf(out, size, "%s, logit %.3g", reason, (double)job->answer.opinion.logit);
}

// "hit at t = 0.4, the first contact: proven, two triangles meet".
static void sweep_verdict(const sweep_job *job, const settings *options, char *out, size_t size) {
  const nsvcd_answer *a = &job->answer;
  const float clearance = options->sweep.clearance;
  const int collides = collides_of(a);
  const char *word = collides ? "hit" : "free";
  char when[60] = "";
  char near_by[60] = "";
  char reason[120];
  if (collides)
    snprintf(when, sizeof when, " at t = %.4f%s", (double)contact_time_of(a),
             wants_first(options) ? ", the first contact" : "");
  if (hides_first(a))
    snprintf(when, sizeof when, " at t = %.4f, and not before t = %.4f", (double)a->time.high,
             (double)a->time.low);
  if (a->verdict == NSVCD_UNDECIDED) {
    word = collides ? "undecided, taken as a hit" : "undecided, taken as free";
    snprintf(when, sizeof when, "; free until t = %.4f", (double)a->time.low);
  }
  if (clearance > 0)
    snprintf(near_by, sizeof near_by, ", %s %g m", collides ? "as near as" : "never as near as",
             (double)clearance);
  sweep_reason(job, options, reason, sizeof reason);
  snprintf(out, size, "%s%s%s: %s", word, when, near_by, reason);
}

// size: what is less than a millionth of it is rounding, and printed as 0.
static void print_vector(const char *name, const float *v, double size, const char *unit) {
  printf("%-10s", name);
  for (int k = 0; k < 3; k++)
    printf(" %.5g", fabs((double)v[k]) < 1e-6 * size ? 0.0 : (double)v[k]);
  printf("%s\n", unit);
}

static void print_answer(const sweep_job *job, const settings *options) {
  const nsvcd_answer *a = &job->answer;
  char verdict[320];
  double size = 0;
  for (int k = 0; k < 3; k++) size = fmax(size, job->b.high[k] - job->b.low[k]);
  sweep_verdict(job, options, verdict, sizeof verdict);
  printf("%s\n", verdict);
  const int is_proven = a->verdict == NSVCD_HIT && a->by == NSVCD_BY_PROOF;
  if (is_proven) print_vector("point", a->nearest.point, size, " m");
  if (a->contact_count > 0) {
    // what is met of a sheet has a normal by its winding, on whichever side A is
    const int sure = is_solid(&job->a) && is_solid(&job->b);
    print_vector("normal", a->contacts[0].normal, 1, sure ? ", from B to A" : "");
    printf("triangles  %lu of A, %lu of B, counted from 0\n",
           (unsigned long)a->contacts[0].triangle_a, (unsigned long)a->contacts[0].triangle_b);
  }
  if (job->nearest.distance.high > 0)
    printf("clearance  %.4g to %.4g m, at t = %.4f\n", (double)job->nearest.distance.low,
           (double)job->nearest.distance.high, (double)job->nearest.nearest.time);
  print_motion(&job->motion);
  printf("time       %.1f us", job->microseconds);
  if (job->microseconds_first > 0)
    printf(", and %.1f us for the first contact", job->microseconds_first);
  printf(" (median of %zu)", options->repeat);
  if (job->a.taken + job->b.taken > 0)
    printf("; encoding %.1f ms", 1e3 * (job->a.taken + job->b.taken));
  printf("\n");
  fflush(stdout);
}

// ------------------------------------------------------------------------------------- its picture

// The mesh, or, of a .body file, the balls of its patches. Returns 0 after a complaint.
static int picture_body(const thing *t, sweep_body *out) {
  shapes_mesh balls;
  float centre[3], radius;
  memset(&balls, 0, sizeof balls);
  out->name = t->path;
  out->pale = t->memory ? 0.12 : 0.35;  // balls overlap
  out->sheet = !t->memory && !is_solid(t);
  for (uint32_t i = 0; t->memory && nsvcd_body_patch(t->body, i, centre, &radius); i++) {
    const size_t first = balls.vertices;
    shapes_ellipsoid(&balls, (double)radius, (double)radius, (double)radius, 6);
    shapes_place(&balls, first, NULL, (double)centre[0], (double)centre[1], (double)centre[2]);
  }
  for (size_t i = 0; !t->memory && i < t->mesh.vertex_count; i++) {
    const float *p = t->mesh.positions + 3 * i;
    shapes_vertex(&balls, (double)p[0], (double)p[1], (double)p[2]);
  }
  const int good =
      !balls.failed &&
      oracle_mesh_init(&out->mesh, balls.positions, balls.vertices,
                       t->memory ? balls.indices : t->mesh.indices,
                       t->memory ? balls.triangles : t->mesh.triangle_count, (double)t->scale);
  shapes_free(&balls);
  return good ? 1 : complain("out of memory");
}

static int draw_job(const sweep_job *job, const settings *options) {
  const nsvcd_answer *a = &job->answer;
  sweep_picture p;
  char verdict[320];
  memset(&p, 0, sizeof p);
  sweep_verdict(job, options, verdict, sizeof verdict);
  const int collides = collides_of(a);
  p.title = collides ? "A hits B" : "A is free of B";
  if (a->verdict == NSVCD_UNDECIDED) p.title = "Undecided";
  p.verdict = verdict;
  p.poses = job->motion.poses;
  p.count = job->motion.count;
  p.collides = collides;
  p.shown = collides ? (double)contact_time_of(a) : 0.5;
  p.shown_as = collides ? "contact" : "half way";
  if (job->nearest.distance.high > 0) {
    p.shown = (double)job->nearest.nearest.time;
    p.shown_as = "nearest";
  }
  if (a->contact_count > 0) {
    p.point = a->contacts[0].point;
    p.normal = a->contacts[0].normal;
  }
  const int good = picture_body(&job->a, &p.a) && picture_body(&job->b, &p.b) &&
                   sweep_draw(options->picture, &p);
  oracle_mesh_free(&p.a.mesh);
  oracle_mesh_free(&p.b.mesh);
  if (good) printf("picture    %s\n", options->picture);
  return good;
}

static int sweep_run(sweep_job *job, settings *options, const float *scales) {
  const motion_told told = {options->from, options->to, options->rotate};
  if (options->sweep.method == NSVCD_METHOD_NETWORK) options->encode.no_triangles = 1;
  // a body may hold no triangles: then the network answers
  options->encode.latents = is_body_file(options->paths[0]) || is_body_file(options->paths[1]);
  if (!load_thing(options->paths[0], scales[0], &options->encode, &job->a) ||
      !load_thing(options->paths[1], scales[1], &options->encode, &job->b))
    return REFUSED;
  if (!take_motion(&told, &job->a, &job->b, &job->motion)) return USAGE;
  const int status = sweep_method(job, options);
  if (status != DONE) return status;
  if (!sweep_ask(job, options)) return REFUSED;
  print_answer(job, options);
  if (options->certificate) {
    if (!write_proof(options->certificate, options->paths, scales, job->poses, job->motion.count,
                     options->sweep.clearance, &job->answer))
      return REFUSED;
    printf("certificate  %s, of the problem in %.*stxt\n", options->certificate,
           (int)strlen(options->certificate) - 4, options->certificate);
  }
  return !options->picture || draw_job(job, options) ? DONE : REFUSED;
}

static int sweep(settings *options) {
  float scales[2];
  if (options->path_count != 2)
    return usage_error("sweep", "two files are wanted, A and B ('svcd sweep --help')");
  if (options->picture && !ends_with(options->picture, ".svg"))
    return complain("--picture: %s does not end in .svg", options->picture), USAGE;
  if (options->certificate &&
      (!ends_with(options->certificate, ".cert") || options->sweep.skin > 0 ||
       is_body_file(options->paths[0]) || is_body_file(options->paths[1])))
    return usage_error("--certificate", "a file that ends in .cert; of meshes, without --skin");
  if (!take_scales(options->scale, 2, scales)) return USAGE;
  if (options->picture && !draw_may_write(options->picture)) return REFUSED;
  sweep_job *job = (sweep_job *)allocate(sizeof *job);
  memset(job, 0, sizeof *job);
  job->workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  const int status = sweep_run(job, options, scales);
  free_thing(&job->a);
  free_thing(&job->b);
  free(job->workspace);
  free(job);
  return status;
}

// -------------------------------------------------------------------------------------------- help

static void help_sweep(FILE *out) {
  fprintf(
      out,
      "svcd sweep A B [--from POSE] [--to POSE] [--rotate AXIS,DEGREES] [--scale S[,S]]\n"
      "           [--picture OUT.svg] [--certificate OUT.cert] [--clearance METRES]\n"
      "           [--measure METRES] [--skin METRES]\n"
      "           [--first T|METRESm] [--method proof|network] [--points N] [--work N] [--repeat "
      "R]\n"
      "A moves, B rests where its file has it: do they hit each other? A and B are OBJ or .body\n"
      "files. Without --from and --to A passes straight through the middle of B's box, from\n"
      "outside to outside, downwards along the axis along which B is thinnest.\n"
      "  --from, --to POSE  x,y,z[,qx,qy,qz,qw]: where A's origin is at t = 0 and t = 1, and how\n"
      "                     it is turned; one that is not given: as the file has it\n"
      "  --rotate AXIS,DEG  turn on the way, about A's origin: z,90\n"
      "  --scale S[,S]      to metres: 0.001 of millimetres; of both, or of A and of B (1)\n"
      "  --picture OUT.svg  draws B, and A at the start, at the contact and at the end\n"
      "  --certificate OUT.cert  writes a proof of the answer, and what it is about to OUT.txt:\n"
      "                     build/verify OUT.txt FOLDER checks it\n"
      "  --clearance M      to come as near as this is a hit (0: to meet is)\n"
      "  --measure M        if they are free: how near do they come? to this\n"
      "  --skin M           to touch at the start, no deeper than this, is no hit (0)\n"
      "  --first T|METRESm  the time of the contact is that of the first one, to this share of\n"
      "                     the motion, or to metres: 0.001m (0.001; 0: of any contact)\n"
      "  --method M         proof: a witness or a certificate; network: an opinion (proof)\n"
      "  --points N         patches of a body, 1..%d (%d and more; %d for the network)\n"
      "  --work N           units that a proof may take (%d)\n"
      "  --repeat R         timed queries, of which the median is printed (101)\n"
      "The first line begins with hit, free or undecided; the exit status is 0 for all of them.\n",
      NSVCD_MAX_PATCHES, NSVCD_DEFAULT_PATCHES, NSVCD_DEFAULT_NETWORK_PATCHES, NSVCD_DEFAULT_WORK);
}

static void help_info(FILE *out) {
  fprintf(
      out,
      "svcd info FILE.obj|FILE.body [--scale S]\n"
      "Of an OBJ: triangles, box, components, area and volume, the body that it makes, and\n"
      "what is wrong with it: a size that is hardly meant, inside out, open edges, winding that\n"
      "does not agree, non-manifold edges, triangles without area or too large for the patches.\n"
      "Of a body: patches, bytes, triangles, sphere.\n"
      "  --scale S  to metres: 0.001 of millimetres (1)\n");
}

static void help_encode(FILE *out) {
  fprintf(out,
          "svcd encode IN.obj OUT.body|OUT.h [--scale S] [--points N | --radius METRES]\n"
          "            [--latents | --no-triangles]\n"
          "Encodes a mesh, to a file or to a C array.\n"
          "  --scale S        to metres: 0.001 of millimetres (1)\n"
          "  --points N       patches, 1..%d (%d and more, by the number of triangles)\n"
          "  --radius METRES  as many as make patches of this radius\n"
          "  --latents        for the network too, not for the proof alone\n"
          "  --no-triangles   for the network alone\n",
          NSVCD_MAX_PATCHES, NSVCD_LEAST_PATCHES);
}

static void help_check(FILE *out) {
  fprintf(
      out,
      "svcd check [--method proof|network] [--points N] [--pairs K] [--model tiny|small|base]\n"
      "           [--int8] [--recall R] [--clearance METRES] [--first T|METRESm]\n"
      "           [--skin METRES] [--work LIMIT] [--repeat R] [--details OUT.tsv]\n"
      "           [--certificates FOLDER] FILE\n"
      "Answers the problems of FILE, a line each on standard output, separated by tabs:\n"
      "ID LOGIT COLLIDES TIME MOVING_PATCH FIXED_PATCH STATUS MICROSECONDS; a summary on\n"
      "standard error.\n"
      "  --method M          proof: a witness or a certificate; network: an opinion (proof)\n"
      "  --points N          patches of a body, 1..%d (%d and more; %d for the network)\n"
      "  --pairs K           pairs of patches that the network looks at, 1..%d (8)\n"
      "  --model M           decoder (base)\n"
      "  --int8              the decoder in 8-bit integers\n"
      "  --recall R          share of collisions to be found: 0.99, 0.999, 0.9999 or 0:\n"
      "                      balanced errors (0)\n"
      "  --clearance METRES  to come as close as this is a collision (0: to meet is)\n"
      "  --first T|METRESm   TIME is that of the first contact, to this share of the motion, or\n"
      "                      to metres: 0.001m (0: of any contact)\n"
      "  --skin METRES       what is touched at the start, no deeper than this, does not count\n"
      "  --work LIMIT        units that a proof may take (%d)\n"
      "  --repeat R          time every query R times, report the least (5)\n"
      "  --details OUT.tsv   writes all that is known, a line a problem: brackets of time and\n"
      "                      distance, depth, where it is safe to go, contacts\n"
      "  --certificates FOLDER  writes a proof of each answer, ID.cert, into a folder that is\n"
      "                      there: build/verify FILE FOLDER checks them\n",
      NSVCD_MAX_PATCHES, NSVCD_DEFAULT_PATCHES, NSVCD_DEFAULT_NETWORK_PATCHES, NSVCD_MAX_PAIRS,
      NSVCD_DEFAULT_WORK);
}

static void help_plan(FILE *out) {
  fprintf(
      out,
      "svcd plan [--clearance METRES] [--seed S] [--only ID[,ID]] [--samples N --joints "
      "OUT.tsv]\n"
      "          [--picture OUT.svg] [--film OUT.svg] [--certificates FOLDER] FILE\n"
      "Seeks a motion for each plan of a planning file, and proves it. A line each, separated\n"
      "by tabs: ID certified|start|goal|limit|undecided SECONDS DURATION LENGTH\n"
      "  --clearance D       the motion keeps this away from all that it must not touch (0)\n"
      "  --seed S            of the random numbers (0)\n"
      "  --only ID,ID        these alone\n"
      "  --samples N --joints OUT.tsv   the joints at N times, a line each: ID K JOINTS\n"
      "  --certificates FOLDER          a proof of each motion, ID.cert, into a folder that is\n"
      "                      there: build/verify FILE FOLDER checks them\n"
      "  --picture, --film OUT.svg      the motion of one plan, which is named by --only\n");
}
static void help_path(FILE *out) {
  fprintf(out,
          "svcd path [--clearance METRES] [--only ID[,ID]] FILE\n"
          "Is each path of a planning file free, between its points as well? A line each,\n"
          "separated by tabs: ID free|hit|undecided EDGE T NAME NAME MICROSECONDS: the first edge\n"
          "that is not free, when, and which two bodies; the mean of an edge.\n"
          "  --clearance D       to come as near as this is a hit (0)\n"
          "  --only ID,ID        these alone\n");
}

static void help_pairs(FILE *out) {
  fprintf(out,
          "svcd pairs [--seed S] FILE\n"
          "Which bodies of a planning file's robot can meet each other? A line 'pair NAME NAME'\n"
          "for each two, to stand in the file; in comments those that one joint parts, and those\n"
          "that touch in each of 64 random configurations, which are not worth asking.\n"
          "  --seed S            of the configurations (0)\n");
}

typedef struct command {
  const char *name;
  unsigned bit;
  int (*run)(settings *options);
  void (*help)(FILE *out);
  size_t paths;   // at most
  size_t repeat;  // where --repeat is not given
  float first;    // where --first is not given
} command;

static const command commands[] = {
    {"sweep", SWEEP, sweep, help_sweep, 2, 101, 0.001f},
    {"info", INFO, info, help_info, 1, 0, 0},
    {"encode", ENCODE, encode, help_encode, 2, 0, 0},
    {"check", CHECK, check, help_check, 1, 5, 0},
    {"plan", PLAN, plan, help_plan, 1, 0, 0},
    {"path", PATH, path, help_path, 1, 0, 0},
    {"pairs", PAIRS, pairs, help_pairs, 1, 0, 0},
};
#define COMMANDS (sizeof commands / sizeof commands[0])

static void usage(FILE *out) {
  fprintf(
      out,
      "svcd - does a body, moving so, hit another one? (neuralsvcd.h)\n"
      "  svcd sweep A.obj B.obj            A moves, B rests: do they hit, when and where\n"
      "  svcd info FILE.obj                what a mesh is, and what is wrong with it\n"
      "  svcd encode IN.obj OUT.body       a body, ready to be loaded, or a C array OUT.h\n"
      "  svcd check PROBLEMS.txt           answers a file of problems\n"
      "  svcd plan ROBOT.txt               motions of a robot, sought and proven\n"
      "  svcd path ROBOT.txt               are paths of a robot free, between their points too?\n"
      "  svcd pairs ROBOT.txt              which bodies of a robot can meet each other?\n"
      "  svcd COMMAND --help               its options\n"
      "Exit status: 0 done, 1 a file or a line was refused, 2 usage.\n"
      "What it reads and prints: examples/FORMATS.md.\n");
}

static const command *find_command(const char *name) {
  for (size_t i = 0; i < COMMANDS; i++)
    if (strcmp(name, commands[i].name) == 0) return &commands[i];
  return NULL;
}

static int no_command(const char *name) {
  const char *meant = NULL;
  size_t distance = 3;
  for (size_t i = 0; i < COMMANDS; i++) consider(name, commands[i].name, &meant, &distance);
  if (ends_with(name, ".obj") || ends_with(name, ".body")) meant = "sweep A.obj B.obj";
  if (meant)
    complain("no command '%s'; did you mean 'svcd %s'?", name, meant);
  else
    complain("no command '%s': there are sweep, info, encode, check, plan and path ('svcd --help')",
             name);
  return USAGE;
}

static int run(const command *c, int argc, char **argv) {
  const command_line line = {options, OPTION_COUNT_OF, c->bit, c->name, argv, argc};
  settings given;
  memset(&given, 0, sizeof given);
  given.repeat = c->repeat;
  given.first[0] = c->first;
  const int status = take_options(&line, &given, given.paths, c->paths, &given.path_count);
  if (status != DONE) return status;
  if (!given.help) return c->run(&given);
  c->help(stdout);
  return DONE;
}

static int serve(int argc, char **argv) {
  const char *name = argc > 1 ? argv[1] : "";
  const int help =
      strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0;
  if (argc < 2) {
    usage(stderr);
    return USAGE;
  }
  if (help && argc > 2) name = argv[2];
  const command *c = find_command(name);
  if (help) {
    if (argc > 2 && !c) return no_command(name);
    (c ? c->help : usage)(stdout);
    return DONE;
  }
  return c ? run(c, argc - 2, argv + 2) : no_command(name);
}

int main(int argc, char **argv) {
  const int status = serve(argc, argv);
  if (fflush(stdout) == 0 && !ferror(stdout)) return status;
  complain("standard output cannot be written");
  return status == DONE ? REFUSED : status;
}
