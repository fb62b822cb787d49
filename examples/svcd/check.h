// check.h - svcd check: answers a file of problems.
#ifndef NSVCD_SVCD_CHECK_H
#define NSVCD_SVCD_CHECK_H

#include "settings.h"

// Encodes every mesh once, in the units of its file; questions have its scale. bodies:
// (mesh_count), zeroed.
static int encode_meshes(const problem_file *file, const nsvcd_encode_options *options,
                         encoded *bodies) {
  progress_bar working = {"meshes encoded", file->mesh_count, 0, 0};
  for (size_t i = 0; i < file->mesh_count; i++) {
    const mesh_entry *mesh = &file->meshes[i];
    progress_step(&working, i);
    char from[1024];
    snprintf(from, sizeof from, "%s:%zu: mesh %s: ", file->path, mesh->line, mesh->name);
    bodies[i].body = encode_named(from, file->path, mesh->path, NULL, options, &bodies[i].seconds);
    if (!bodies[i].body) return 0;
  }
  progress_end(&working);
  return 1;
}

// Answers one problem: once to warm up, then --repeat times by the clock. The shortest time counts:
// longer ones include other work of the machine.
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
  progress_bar working = {"problems answered", s->file.problem_count, 0, 0};
  for (size_t i = 0; i < s->file.problem_count && good; i++) {
    progress_step(&working, i);
    good = answer(s, options, workspace, &s->file.problems[i], &s->outcomes[i]);
  }
  progress_end(&working);
  free(workspace);
  return good;
}

static int print_answers(const session *s, int is_json) {
  for (size_t i = 0; i < s->file.problem_count; i++) {
    const nsvcd_answer *a = &s->outcomes[i].answer;
    const char *id = s->file.problems[i].id;
    const char *word = status_string(hides_first(a) ? STATUS_UNDECIDED : status_of(a));
    const double microseconds = s->outcomes[i].microseconds;
    uint32_t patch_a, patch_b;
    patches_of(a, &patch_a, &patch_b);
    if (!is_json) {
      printf("%s\t%.9g\t%d\t%.9g\t%lu\t%lu\t%s\t%.2f\n", id, (double)logit_of(a), collides_of(a),
             (double)contact_time_of(a), (unsigned long)patch_a, (unsigned long)patch_b, word,
             microseconds);
      continue;
    }
    json_out j = {stdout, 0};
    json_open(&j, NULL, '{');
    json_text(&j, "id", id);
    json_float(&j, "logit", (double)logit_of(a));
    json_flag(&j, "collides", collides_of(a));
    json_float(&j, "time", (double)contact_time_of(a));
    json_count(&j, "moving_patch", patch_a);
    json_count(&j, "fixed_patch", patch_b);
    json_text(&j, "status", word);
    json_digits(&j, "microseconds", microseconds, 4);
    json_end_line(&j);
  }
  if (fflush(stdout) == 0 && !ferror(stdout)) return 1;
  return complain("standard output: %s", strerror(errno));
}

// Prints nan for what is unknown.
static void print_numbers(FILE *out, const float *numbers, size_t count) {
  for (size_t k = 0; k < count; k++) {
    if (isinf(numbers[k])) fprintf(out, "\tnan");
    if (!isinf(numbers[k])) fprintf(out, "\t%.9g", (double)numbers[k]);
  }
}

// Writes all that is known of each answer, one line per problem.
static int write_details(const session *s, const char *path) {
  FILE *out = open_file(path, "w");
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

// The library knows which recalls it was calibrated for: ask it, with a body of one triangle,
// before any work is done.
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
    return usage_error("check", "expected a problem file ('svcd check --help')");
  if (options->int8) sweep->network.precision = NSVCD_PRECISION_INT8;
  options->encode.no_triangles = sweep->method == NSVCD_METHOD_NETWORK;
  if (options->encode.no_triangles &&
      (sweep->clearance > 0 || wants_first(options) || sweep->slop > 0))
    return usage_error("--method network",
                       "the network knows neither --clearance, --first nor --skin");
  if (options->details && !ends_with(options->details, ".tsv"))
    return usage_error("--details", "expected a file that ends in .tsv");
  if (options->certificates && (options->encode.no_triangles || sweep->slop > 0))
    return usage_error("--certificates", "not with --method network, nor with --skin");
  if (!recall_is_known(sweep)) return usage_error("--recall", "none of 0, 0.99, 0.999, 0.9999");
  return DONE;
}

// Is there a certificate, and one for each answer? Returns 0 after a complaint.
static int all_are_certified(const session *s, size_t made) {
  size_t answered = 0;
  for (size_t i = 0; i < s->file.problem_count; i++)
    answered += s->outcomes[i].answer.verdict != NSVCD_UNDECIDED;
  if (made > 0 && made >= answered) return 1;
  return complain("--certificates: %zu written, of %zu answers", made, answered);
}

static int check(settings *options) {
  const int status = check_options(options);
  if (status != DONE) return status;
  session s;
  memset(&s, 0, sizeof s);
  size_t made;
  int good = read_problems(options->paths[0], &s.file);
  if (good) {
    s.bodies = (encoded *)allocate(s.file.mesh_count * sizeof *s.bodies);
    s.outcomes = (outcome *)allocate(s.file.problem_count * sizeof *s.outcomes);
    memset(s.bodies, 0, s.file.mesh_count * sizeof *s.bodies);
  }
  good = good && encode_meshes(&s.file, &options->encode, s.bodies) && answer_all(&s, options) &&
         (!options->details || write_details(&s, options->details)) &&
         print_answers(&s, options->json) &&
         (!options->certificates ||
          write_certificates(&s, options->certificates, options->sweep.clearance, options->visits,
                             &made));
  if (good) print_summary(&s);
  if (good && options->certificates) good = all_are_certified(&s, made);
  for (size_t i = 0; s.bodies && i < s.file.mesh_count; i++)
    nsvcd_body_free(s.bodies[i].body, NULL);
  free(s.bodies);
  free(s.outcomes);
  free_problems(&s.file);
  return good ? DONE : REFUSED;
}

#endif
