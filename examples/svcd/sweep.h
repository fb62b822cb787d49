// sweep.h - svcd sweep: one question about two files, its answer, its picture, its proof.
#ifndef NSVCD_SVCD_SWEEP_H
#define NSVCD_SVCD_SWEEP_H

#include "sweep_warnings.h"

#define FIRST 0.001f          // the first contact, to this fraction of a motion
#define FIRST_OF_TABLE 1e-6f  // and of one by a table, to name the line

typedef struct sweep_job {
  thing a, b;  // a moves
  motion motion;
  nsvcd_pose *poses;  // (motion.count)
  float *times;       // (motion.count); NULL: uniform
  nsvcd_question question;
  int by_proof;
  void *workspace;
  nsvcd_answer answer;
  nsvcd_answer nearest;  // the distance, with --measure, if they are free of each other
  waiting wait;
  size_t repeated;            // timed runs
  double microseconds;        // median, to know whether they meet
  double microseconds_first;  // and when first
} sweep_job;

// The network answers if a body holds no triangles; then nothing may be asked that only a proof
// answers. Returns a status.
static int sweep_method(sweep_job *job, settings *options) {
  const nsvcd_question *sweep = &options->sweep;
  const thing *bare = nsvcd_body_describe(job->a.body).triangles ? &job->b : &job->a;
  const int proof = sweep->method != NSVCD_METHOD_NETWORK;
  job->by_proof = proof && nsvcd_body_describe(bare->body).triangles;
  if (job->by_proof) return DONE;
  if (sweep->method == NSVCD_METHOD_PROOF) {
    complain("%s: it holds no triangles, so there is no proof", bare->path);
    return REFUSED;
  }
  if (sweep->clearance > 0 || options->measure > 0 || sweep->slop > 0) {
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

// Asks the question once. Returns 0 after a complaint.
static int sweep_once(sweep_job *job, nsvcd_answer *answer) {
  const nsvcd_result result =
      nsvcd_sweep(&job->question, job->workspace, nsvcd_sweep_workspace_size(NULL), answer);
  return result ? complain("%s", reason_of(result)) : 1;
}

// Asks the question until it is decided or time is up. It keeps the work that it took. Returns 0
// after a complaint.
static int sweep_decided(sweep_job *job, size_t work, nsvcd_answer *answer) {
  int good = 1;
  for (int again = 1; again && good;) {
    const double start = seconds();
    job->question.work = work;
    good = sweep_once(job, answer);
    again = 0;
    if (good && job->by_proof && answer->why == NSVCD_WHY_WORK) {
      work = more_work(&job->wait, answer->work > work ? answer->work : work, seconds() - start);
      again = work > 0;
    }
  }
  wait_no_more(&job->wait);
  return good;
}

// Asks once to warm up, then by the clock as often as a second allows. Returns the median in
// microseconds, negative after a complaint.
static double sweep_timed(sweep_job *job, const settings *options, nsvcd_answer *answer) {
  double *times = (double *)allocate(options->repeat * sizeof *times);
  int good = sweep_decided(job, options->sweep.work, answer);
  const double began = seconds();
  size_t count = 0;
  while (good && count < options->repeat && (count == 0 || seconds() - began < 1)) {
    const double start = seconds();
    good = sweep_once(job, answer);
    times[count++] = 1e6 * (seconds() - start);
  }
  if (good) qsort(times, count, sizeof *times, compare_doubles);
  const double median = good ? (times[(count - 1) / 2] + times[count / 2]) / 2 : -1;
  job->repeated = count;
  free(times);
  return median;
}

// Makes the library's poses and times of the motion. Returns 0 after a complaint.
static int sweep_round(sweep_job *job) {
  const motion *m = &job->motion;
  job->poses = (nsvcd_pose *)allocate(m->count * sizeof *job->poses);
  for (size_t i = 0; i < m->count; i++) job->poses[i] = pose_rounded(&m->poses[i]);
  if (!m->is_timed || m->count == 1) return 1;
  job->times = (float *)allocate(m->count * sizeof *job->times);
  for (size_t i = 0; i < m->count; i++) {
    job->times[i] = pose_to_float(share_of_pose(m, i));
    if (i > 0 && !(job->times[i] - job->times[i - 1] >= 1e-7f))  // what the library takes
      return complain("--poses: line %zu: its time is too near that of the line before",
                      m->lines[i]);
  }
  return 1;
}

// What is asked of both bodies. poses: (count, 7) of A.
static void sweep_begin(sweep_job *job, const settings *options, const nsvcd_pose *poses,
                        size_t count) {
  nsvcd_question *question = &job->question;
  *question = options->sweep;
  question->a.body = job->a.body;
  question->a.poses = poses;
  question->a.count = count;
  question->a.scale = job->a.scale;
  question->b.body = job->b.body;
  question->b.scale = job->b.scale;
}

// Asks the question, and, if the bodies are free of each other, how near they come.
static int sweep_ask(sweep_job *job, const settings *options) {
  nsvcd_question *question = &job->question;
  sweep_begin(job, options, job->poses, job->motion.count);
  question->a.times = job->times;
  job->wait = wait_for(options);
  job->microseconds = sweep_timed(job, options, &job->answer);
  if (job->microseconds < 0) return 0;
  if (job->answer.verdict != NSVCD_FREE && wants_first(options)) {
    ask_first(question, options);
    job->microseconds_first = sweep_timed(job, options, &job->answer);
  }
  if (!(options->measure > 0) || collides_of(&job->answer)) return job->microseconds_first >= 0;
  question->clearance = question->to_time = 0;
  question->ask = NSVCD_ASK_DISTANCE;
  question->to = options->measure;
  return sweep_decided(job, options->sweep.work, &job->nearest);
}

// Says how it was decided.
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
    reason = job->answer.why == NSVCD_WHY_OPEN
                 ? "one seems to be inside of what is nearly a solid, but not closed"
             : job->answer.why == NSVCD_WHY_WORK ? "more work than --work or --seconds allow"
                                                 : "too near each other to tell";
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
  char when[160] = "";
  char low[60], at[60];
  char near_by[60] = "";
  char reason[120];
  const double until = (double)a->time.low;
  const double met = (double)(collides ? contact_time_of(a) : 0);
  shown_time(&job->motion, until, until, low, sizeof low);
  // contact at a pose is one on the way there, as --all has it
  shown_time(&job->motion, met, fmax(until, met - 2 * (double)FIRST_OF_TABLE), at, sizeof at);
  if (collides)
    snprintf(when, sizeof when, " at %s, %s", at,
             wants_first(options) || !(contact_time_of(a) > 0) ? "the first contact"
                                                               : "perhaps not the first contact");
  if (hides_first(a)) {
    shown_time(&job->motion, (double)a->time.high, (double)a->time.high, at, sizeof at);
    snprintf(when, sizeof when, " at %s, and not before %s", at, low);
  }
  if (a->verdict == NSVCD_UNDECIDED) {
    word = collides ? "undecided, taken as a hit" : "undecided, taken as free";
    snprintf(when, sizeof when, "; free until %s", low);
  }
  if (clearance > 0)
    snprintf(near_by, sizeof near_by, ", %s %g m", collides ? "as near as" : "never as near as",
             (double)clearance);
  sweep_reason(job, options, reason, sizeof reason);
  snprintf(out, size, "%s%s%s: %s", word, when, near_by, reason);
}

// Prints as 0 what is less than a millionth of `size`: it is rounding.
static void print_vector(const char *name, const float *v, double size, const char *unit) {
  printf("%-10s", name);
  for (int k = 0; k < 3; k++)
    printf(" %.5g", fabs((double)v[k]) < 1e-6 * size ? 0.0 : (double)v[k]);
  printf("%s\n", unit);
}

static void print_answer(const sweep_job *job, const settings *options) {
  const nsvcd_answer *a = &job->answer;
  char verdict[420], when[60];
  double size = 0;
  for (int k = 0; k < 3; k++) size = fmax(size, job->b.high[k] - job->b.low[k]);
  sweep_verdict(job, options, verdict, sizeof verdict);
  printf("%s\n", verdict);
  const int is_proven = a->verdict == NSVCD_HIT && a->by == NSVCD_BY_PROOF;
  if (is_proven) print_vector("point", a->nearest.point, size, " m");
  if (a->contact_count > 0) {
    // the normal of a sheet follows its winding, on whichever side A is
    const int sure = is_solid(&job->a) && is_solid(&job->b);
    print_vector("normal", a->contacts[0].normal, 1, sure ? ", from B to A" : "");
    printf("triangles  %lu of A, %lu of B, counted from 0\n",
           (unsigned long)a->contacts[0].triangle_a, (unsigned long)a->contacts[0].triangle_b);
  }
  const double nearest = (double)job->nearest.nearest.time;
  if (job->nearest.distance.high > 0) shown_time(&job->motion, nearest, nearest, when, sizeof when);
  if (job->nearest.distance.high > 0)
    printf("clearance  %.4g to %.4g m, at %s\n", (double)job->nearest.distance.low,
           (double)job->nearest.distance.high, when);
  print_motion(&job->motion);
  for (int i = 0; i < 2; i++) {
    const thing *t = i ? &job->b : &job->a;
    if (t->recentre)
      printf("origin     of %c: %.0f %.0f %.0f, in its file's units\n", "AB"[i], t -> origin[0],
             t -> origin[1], t -> origin[2]);
  }
  printf("time       %.1f us", job->microseconds);
  if (job->microseconds_first > 0)
    printf(", and %.1f us for the first contact", job->microseconds_first);
  printf(" (median of %zu)", job->repeated);
  if (job->a.taken + job->b.taken > 0)
    printf("; encoding %.1f ms", 1e3 * (job->a.taken + job->b.taken));
  printf("\n");
  fflush(stdout);
}

// ------------------------------------------------------------------------------------ all contacts

// Tells of stretches from pose `from` to pose `to`; `first` answers for the first of them.
static void tell_stretches(const sweep_job *job, json_out *json, size_t from, size_t to,
                           const nsvcd_answer *first) {
  const motion *m = &job->motion;
  const int is_hit = first->verdict == NSVCD_HIT;
  const size_t last = to < m->count ? to : from;
  const double begins = share_of_pose(m, from);
  const double lasts = m->count > 1 ? share_of_pose(m, from + 1) - begins : 0;
  const double share = begins + lasts * (is_hit ? (double)contact_time_of(first) : 0);
  const char *note = m->notes[m->count > 1 ? from + 1 : from];
  char when[60];
  shown_time(m, share, begins, when, sizeof when);
  if (json) {
    json_open(json, NULL, '{');
    json_text(json, "verdict", nsvcd_verdict_string(first->verdict));
    json_count(json, "from_line", m->lines[from]);
    json_count(json, "to_line", m->lines[last]);
    json_float(json, "time", share);
    if (is_hit) json_floats(json, "point", first->nearest.point, 3);
    if (*note) json_text(json, "note", note);
    json_close(json, '}');
    return;
  }
  printf("%-10s lines %zu to %zu", is_hit ? "contact" : "undecided", m->lines[from],
         m->lines[last]);
  if (is_hit)
    printf(", first at %s: %.5g %.5g %.5g m", when, (double)first->nearest.point[0],
           (double)first->nearest.point[1], (double)first->nearest.point[2]);
  printf("%s%s\n", *note ? "  # " : "", note);
}

// Asks about each stretch between two poses by itself, and tells those with a contact: neighbours
// together, with the first contact of theirs. Returns 0 after a complaint.
static int sweep_all(sweep_job *job, const settings *options, json_out *json) {
  const motion *m = &job->motion;
  const size_t stretches = m->count > 1 ? m->count - 1 : 1;
  size_t counts[3] = {0, 0, 0};  // by the verdict
  size_t from = 0;               // where the run of stretches that are not free begins
  nsvcd_answer first;
  progress_bar bar = {"stretches", stretches, 0, 0};
  memset(&first, 0, sizeof first);
  sweep_begin(job, options, job->poses, m->count > 1 ? 2 : 1);
  ask_first(&job->question, options);
  if (!options->is_first_given) job->question.to_time = FIRST;
  if (json) json_open(json, "all", '[');
  for (size_t i = 0; i <= stretches; i++) {
    nsvcd_answer now;
    memset(&now, 0, sizeof now);
    now.verdict = NSVCD_FREE;
    job->question.a.poses = job->poses + i;
    if (i < stretches) {
      job->wait = wait_for(options);
      if (!sweep_decided(job, options->sweep.work, &now)) return 0;
      counts[now.verdict]++;
      progress_step(&bar, i);
    }
    if (i > from && now.verdict != first.verdict && first.verdict != NSVCD_FREE)
      tell_stretches(job, json, from, i, &first);
    if (i == 0 || now.verdict != first.verdict) {
      first = now;
      from = i;
    }
  }
  progress_end(&bar);
  if (json) json_close(json, ']');
  if (!json)
    printf("stretches  %zu: %zu free, %zu with a contact, %zu undecided\n", stretches,
           counts[NSVCD_FREE], counts[NSVCD_HIT], counts[NSVCD_UNDECIDED]);
  return 1;
}

static void json_range(json_out *j, const char *key, const nsvcd_range *range) {
  json_open(j, key, '{');
  json_float(j, "low", (double)range->low);
  json_float(j, "high", (double)range->high);
  json_close(j, '}');
}

// Returns 0 after a complaint.
static int print_json(sweep_job *job, const settings *options) {
  const nsvcd_answer *a = &job->answer;
  json_out j = {stdout, 0};
  json_open(&j, NULL, '{');
  json_text(&j, "verdict", nsvcd_verdict_string(a->verdict));
  json_text(&j, "status", status_string(hides_first(a) ? STATUS_UNDECIDED : status_of(a)));
  json_flag(&j, "collides", collides_of(a));
  json_flag(&j, "proven", a->by == NSVCD_BY_PROOF && a->verdict != NSVCD_UNDECIDED);
  json_range(&j, "time", &a->time);
  json_range(&j, "distance",
             job->nearest.distance.high > 0 ? &job->nearest.distance : &a->distance);
  json_float(&j, "depth", (double)a->depth);
  if (a->opinion.asked) json_float(&j, "logit", (double)a->opinion.logit);
  json_open(&j, "contacts", '[');
  for (size_t n = 0; n < a->contact_count; n++) {
    const nsvcd_contact *contact = &a->contacts[n];
    json_open(&j, NULL, '{');
    json_floats(&j, "point", contact->point, 3);
    json_floats(&j, "normal", contact->normal, 3);
    json_count(&j, "triangle_a", contact->triangle_a);
    json_count(&j, "triangle_b", contact->triangle_b);
    json_close(&j, '}');
  }
  json_close(&j, ']');
  json_open(&j, "poses", '[');
  for (size_t n = 0; n < job->motion.count; n++) {
    float pose[7];
    memcpy(pose, job->poses[n].position, 3 * sizeof *pose);
    memcpy(pose + 3, job->poses[n].rotation, 4 * sizeof *pose);
    json_floats(&j, NULL, pose, 7);
  }
  json_close(&j, ']');
  for (int i = 0; i < 2; i++) {
    const thing *t = i ? &job->b : &job->a;
    if (!t->recentre) continue;
    json_open(&j, i ? "origin_b" : "origin_a", '[');
    for (int k = 0; k < 3; k++) json_digits(&j, NULL, t->origin[k], 17);
    json_close(&j, ']');
  }
  json_digits(&j, "microseconds", job->microseconds, 4);
  if (job->microseconds_first > 0)
    json_digits(&j, "microseconds_first", job->microseconds_first, 4);
  json_count(&j, "repeat", job->repeated);
  if (options->all && !sweep_all(job, options, &j)) return 0;
  json_digits(&j, "milliseconds_encoding", 1e3 * (job->a.taken + job->b.taken), 4);
  json_end_line(&j);
  fflush(stdout);
  return 1;
}

// Writes the proof of the answer. Of a table with times it is one without them: B rests, so that they
// change when something is, not what; asked again, since a contact is where the proof says.
// Returns 0 after a complaint.
static int sweep_prove(sweep_job *job, const settings *options, const float *scales) {
  nsvcd_answer answer = job->answer;
  if (job->times) {
    sweep_begin(job, options, job->poses, job->motion.count);
    if (wants_first(options)) ask_first(&job->question, options);
    job->wait = wait_for(options);
    if (!sweep_decided(job, options->sweep.work, &answer)) return 0;
  }
  if (!write_proof(options->certificate, options->paths, scales, job->poses, job->motion.count,
                   options->sweep.clearance, options->visits, &answer))
    return 0;
  if (!options->json)
    printf("certificate  %s, of the problem in %.*stxt%s\n", options->certificate,
           (int)strlen(options->certificate) - 4, options->certificate,
           job->times ? ", without times: B rests" : "");
  return 1;
}

// ------------------------------------------------------------------------------------- its picture

// Makes what is drawn of a thing: its mesh, or, of a .body file, the balls of its patches. Returns
// 0 after a complaint.
static int picture_body(const thing *t, sweep_body *out) {
  shapes_mesh balls;
  float centre[3], radius;
  memset(&balls, 0, sizeof balls);
  out->name = t->path;
  out->pale = t->is_body ? 0.12 : 0.35;  // paler, since balls overlap
  out->sheet = !t->is_body && !is_solid(t);
  for (uint32_t i = 0; t->is_body && nsvcd_body_patch(t->body, i, centre, &radius); i++) {
    const size_t first = balls.vertices;
    shapes_ellipsoid(&balls, (double)radius, (double)radius, (double)radius, 6);
    shapes_place(&balls, first, NULL, (double)centre[0], (double)centre[1], (double)centre[2]);
  }
  for (size_t i = 0; !t->is_body && i < t->mesh.vertex_count; i++) {
    const float *p = t->mesh.positions + 3 * i;
    shapes_vertex(&balls, (double)p[0], (double)p[1], (double)p[2]);
  }
  const int good =
      !balls.failed &&
      oracle_mesh_init(&out->mesh, balls.positions, balls.vertices,
                       t->is_body ? balls.indices : t->mesh.indices,
                       t->is_body ? balls.triangles : t->mesh.triangle_count, (double)t->scale);
  shapes_free(&balls);
  return good ? 1 : complain("out of memory");
}

static int draw_job(const sweep_job *job, const settings *options) {
  const nsvcd_answer *a = &job->answer;
  sweep_picture p;
  char verdict[420];
  memset(&p, 0, sizeof p);
  sweep_verdict(job, options, verdict, sizeof verdict);
  const int collides = collides_of(a);
  p.title = collides ? "A hits B" : "A is free of B";
  if (a->verdict == NSVCD_UNDECIDED) p.title = "Undecided";
  p.verdict = verdict;
  p.poses = job->motion.poses;
  p.count = job->motion.count;
  p.collides = collides;
  p.shown = collides ? uniform_share(&job->motion, (double)contact_time_of(a)) : 0.5;
  p.shown_as = collides ? "contact" : "half way";
  if (job->nearest.distance.high > 0) {
    p.shown = uniform_share(&job->motion, (double)job->nearest.nearest.time);
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
  if (good && !options->json) printf("picture    %s\n", options->picture);
  return good;
}

static int sweep_run(sweep_job *job, settings *options, const float *scales) {
  motion_told told = {options->from, options->to, options->rotate, options->poses, {0, 0, 0}};
  if (!open_thing(options->paths[0], &job->a) || !open_thing(options->paths[1], &job->b))
    return REFUSED;
  if (options->certificate && (job->a.is_body || job->b.is_body))
    return usage_error("--certificate", "for meshes only");
  job->a.recentre = options->recentre && !job->a.is_body;
  job->b.recentre = options->recentre && !job->b.is_body;
  if (options->sweep.method == NSVCD_METHOD_NETWORK) options->encode.no_triangles = 1;
  // a body without triangles is answered by the network
  options->encode.latents = job->a.is_body || job->b.is_body;
  if (!take_thing(&job->a, scales[0], &options->encode) ||
      !take_thing(&job->b, scales[1], &options->encode))
    return REFUSED;
  warn_of_things(&job->a, &job->b, scales);
  for (int k = 0; k < 3; k++)
    told.shift[k] = (double)scales[0] * job->a.origin[k] - (double)scales[1] * job->b.origin[k];
  job->motion.poses = (oracle_pose *)allocate(NSVCD_MAX_POSES * sizeof *job->motion.poses);
  if (!take_motion(&told, &job->a, &job->b, &job->motion)) return told.poses ? REFUSED : USAGE;
  if (!sweep_round(job)) return REFUSED;
  warn_of_way(&job->a, &job->b, &job->motion);
  const int status = sweep_method(job, options);
  if (status != DONE) return status;
  if (!sweep_ask(job, options)) return REFUSED;
  if (options->json && !print_json(job, options)) return REFUSED;
  if (!options->json) print_answer(job, options);
  if (!options->json && options->all && !sweep_all(job, options, NULL)) return REFUSED;
  options->answer = job->answer.verdict == NSVCD_UNDECIDED ? 3 : job->answer.verdict == NSVCD_HIT;
  if (options->certificate && !sweep_prove(job, options, scales)) return REFUSED;
  return !options->picture || draw_job(job, options) ? DONE : REFUSED;
}

static int sweep(settings *options) {
  float scales[2];
  if (options->path_count != 2)
    return usage_error("sweep", "expected two files, A and B ('svcd sweep --help')");
  const int piped = is_standard_input(options->paths[0]) + is_standard_input(options->paths[1]) +
                    (options->poses && is_standard_input(options->poses));
  if (piped > 1) return usage_error("sweep", "only one of the files may be -, standard input");
  if (options->poses && (options->from || options->to || options->rotate))
    return usage_error("--poses", "not together with --from, --to or --rotate");
  if (options->all && !options->poses) return usage_error("--all", "needs --poses");
  if (!options->is_first_given) options->first[0] = options->poses ? FIRST_OF_TABLE : FIRST;
  if (options->picture && !ends_with(options->picture, ".svg"))
    return complain("--picture: %s does not end in .svg", options->picture), USAGE;
  if (options->certificate && (!ends_with(options->certificate, ".cert") ||
                               options->sweep.slop > 0 || piped || options->recentre))
    return usage_error("--certificate",
                       "expected a file that ends in .cert, without --skin and --recentre, and no "
                       "standard input");
  for (int i = 0; i < 2 && options->certificate; i++)
    if (strpbrk(options->paths[i], " \t#"))
      return usage_error("--certificate", "a problem file can have no blank and no # in names");
  if (!take_scales(options->scale, 2, scales)) return USAGE;
  if (options->picture && !draw_may_write(options->picture)) return REFUSED;
  sweep_job *job = (sweep_job *)allocate(sizeof *job);
  memset(job, 0, sizeof *job);
  job->workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  const int status = sweep_run(job, options, scales);
  free_thing(&job->a);
  free_thing(&job->b);
  free(job->motion.poses);
  free(job->motion.times);
  free(job->motion.lines);
  free(job->motion.notes);
  free(job->motion.text);
  free(job->poses);
  free(job->times);
  free(job->workspace);
  free(job);
  return status;
}

#endif
