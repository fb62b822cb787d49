// certificates.h - writes certificates of problems, which examples/verify checks. Include
// neuralsvcd.h, problem_file.h, load.h, problem_summary.h and robot_file.h first.
#ifndef NSVCD_SCENERY_CERTIFICATES_H
#define NSVCD_SCENERY_CERTIFICATES_H

static void free_trees(proof_mesh *meshes, size_t count) {
  for (size_t i = 0; i < count; i++) free_tree(&meshes[i]);
  free(meshes);
}

// Makes a certificate; *bytes is to be freed. Returns 0 after a complaint.
static int make_certificate(const nsvcd_question *question, const proof_mesh *a,
                            const proof_mesh *b, const nsvcd_answer *answer, size_t visits,
                            uint8_t **bytes, nsvcd_certificate *made) {
  const nsvcd_certify_options options = {answer, visits};
  const size_t size = nsvcd_certify_workspace_size(question, a->tree, b->tree);
  void *workspace = allocate(size);
  size_t room = 4096;
  nsvcd_result result = NSVCD_OK;
  *bytes = NULL;
  do {
    if (*bytes) room = made->size;
    free(*bytes);
    *bytes = (uint8_t *)allocate(room);
    result =
        nsvcd_certify(question, a->tree, b->tree, &options, workspace, size, *bytes, room, made);
  } while (!result && made->size > room);
  free(workspace);
  return result ? complain("the certificate: %s", reason_of(result)) : 1;
}

// Makes and writes one, FOLDER/ID.cert. Where there can be none a file that is there goes. Returns
// 0 after a complaint.
static int write_certificate(const char *folder, const char *id, const nsvcd_question *question,
                             const proof_mesh *a, const proof_mesh *b, const nsvcd_answer *answer,
                             size_t visits, nsvcd_certificate *made) {
  char path[4096];
  uint8_t *bytes;
  snprintf(path, sizeof path, "%s/%s.cert", folder, id);
  int good = make_certificate(question, a, b, answer, visits, &bytes, made);
  if (good && made->size == 0) remove(path);
  if (good && made->size > 0) {
    FILE *file = open_file(path, "wb");
    if (file) fwrite(bytes, 1, made->size, file);
    good = file ? close_written(file, path) : complain("%s: %s", path, strerror(errno));
  }
  free(bytes);
  return good;
}

// One for each problem that has an answer; *made_count: how many. Returns 0 after a complaint.
static int write_certificates(const session *s, const char *folder, float clearance, size_t visits,
                              size_t *made_count) {
  const problem_file *file = &s->file;
  proof_mesh *meshes = (proof_mesh *)allocate(file->mesh_count * sizeof *meshes);
  size_t answered = 0;
  size_t bytes = 0;
  double taken = 0;
  int good = 1;
  *made_count = 0;
  memset(meshes, 0, file->mesh_count * sizeof *meshes);
  for (size_t i = 0; i < file->mesh_count && good; i++)
    good = load_tree(file->path, file->meshes[i].path, NULL, &meshes[i]);
  for (size_t i = 0; i < file->problem_count && good; i++) {
    const problem *p = &file->problems[i];
    const nsvcd_answer *answer = &s->outcomes[i].answer;
    nsvcd_question question = question_of_problem(file, p);
    nsvcd_certificate made;
    question.clearance = clearance;
    const double start = seconds();
    good = write_certificate(folder, p->id, &question, &meshes[p->moving], &meshes[p->fixed],
                             answer, visits, &made);
    taken += seconds() - start;
    if (!good) break;
    answered += answer->verdict != NSVCD_UNDECIDED;
    *made_count += made.size > 0;
    bytes += made.size;
    if (answer->verdict != NSVCD_UNDECIDED && made.verdict != answer->verdict)
      complain("%s:%zu: problem %s: %s, and no certificate of that%s", file->path, p->line, p->id,
               nsvcd_verdict_string(answer->verdict), made.size > 0 ? ", but of the contrary" : "");
  }
  if (good)
    fprintf(stderr, "certificates: %zu, of %zu answers; %.0f bytes and %.0f us on average\n",
            *made_count, answered, *made_count ? (double)bytes / (double)*made_count : 0,
            file->problem_count ? 1e6 * taken / (double)file->problem_count : 0);
  free_trees(meshes, file->mesh_count);
  return good;
}

// ---- of one sweep

// A problem file of one problem, for who checks the certificate: OUT.txt for OUT.cert. Paths of
// meshes are as given, which are from the working folder: so they go up from the file's.
static int write_problem(const char *path, const char *id, const char *const *meshes,
                         const float *scales, const nsvcd_pose *poses, size_t count) {
  FILE *out = open_file(path, "w");
  if (!out) return complain("%s: %s", path, strerror(errno));
  fprintf(out, "nsvcd-problems 1\n");
  for (int k = 0; k < 2; k++) {
    if (path[0] == '/' && meshes[k][0] != '/') {
      fclose(out);
      return complain("%s: a path from the root; name %s so, too", path, meshes[k]);
    }
    fprintf(out, "mesh %c ", k ? 'B' : 'A');
    for (const char *p = path; meshes[k][0] != '/' && p < file_name(path); p++)
      if (*p == '/') fprintf(out, "../");
    fprintf(out, "%s\n", meshes[k]);
  }
  fprintf(out, "problem %s A %.9g B %.9g  0 0 0 0 0 0 1  -1 nan %zu\n", id, (double)scales[0],
          (double)scales[1], count);
  for (size_t k = 0; k < count; k++) {
    for (size_t n = 0; n < 7; n++) {
      const float number = n < 3 ? poses[k].position[n] : poses[k].rotation[n - 3];
      fprintf(out, "%.9g%c", (double)number, n < 6 ? ' ' : '\n');
    }
  }
  return close_written(out, path);
}

// Writes OUT.txt and OUT.cert, of what that file says. Returns 0 after a complaint, also if there can
// be no certificate.
static int write_proof(const char *path, const char *const *meshes, const float *scales,
                       const nsvcd_pose *poses, size_t count, float clearance, size_t visits,
                       const nsvcd_answer *answer) {
  char folder[4096], id[256], problem_path[4096];
  const char *name = file_name(path);
  size_t made;
  session s;
  outcome outcome_of;
  memset(&s, 0, sizeof s);
  memset(&outcome_of, 0, sizeof outcome_of);
  outcome_of.answer = *answer;
  s.outcomes = &outcome_of;
  snprintf(folder, sizeof folder, "%.*s", name > path ? (int)(name - path) - 1 : 1,
           name > path ? path : ".");
  snprintf(id, sizeof id, "%.*s", (int)strlen(name) - 5, name);
  snprintf(problem_path, sizeof problem_path, "%.*stxt", (int)strlen(path) - 4, path);
  const int good = write_problem(problem_path, id, meshes, scales, poses, count) &&
                   read_problems(problem_path, &s.file) &&
                   write_certificates(&s, folder, clearance, visits, &made);
  free_problems(&s.file);
  if (good && !made) return complain("%s: not written: no certificate could be made", path);
  return good;
}

// ---- of a robot's motion

static void put_bytes(FILE *out, uint64_t value, size_t count) {
  for (size_t k = 0; k < count; k++) putc((int)(value >> (8 * k) & 0xff), out);
}
static void put_double(FILE *out, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  put_bytes(out, bits, 8);
}

static void put_pose(FILE *out, const nsvcd_pose *pose) {
  for (size_t k = 0; k < 7; k++) {
    const float number = k < 3 ? pose->position[k] : pose->rotation[k - 3];
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    put_bytes(out, bits, 4);
  }
}

// The tree of a part's mesh, made once for all plans of the file. Returns NULL after a complaint.
static const proof_mesh *tree_of_part(const robot_in_room *in, size_t part) {
  robot_mesh *mesh = &in->file->meshes[robot_thing_of(in, part)->mesh];
  const int good = mesh->proof.tree || load_shape_tree(in->file->path, &mesh->shape, &mesh->proof);
  return good ? &mesh->proof : NULL;
}

static double radius_of_part(const robot_in_room *in, size_t part) {
  return shape_radius(&in->file->meshes[robot_thing_of(in, part)->mesh].shape);
}

// The distance that the skeletons of a pair's shapes keep: a float, and no less.
static float skeleton_clearance(const robot_in_room *in, size_t pair) {
  const nsvcd_body_pair *parts = &in->scene.pairs[pair];
  const double sum =
      (double)in->clearances[pair] + (radius_of_part(in, parts->a) + radius_of_part(in, parts->b));
  const float rounded = (float)sum;
  return (double)rounded < sum ? nextafterf(rounded, HUGE_VALF) : rounded;
}

// A motion with room for more pieces.
typedef struct cut_motion {
  double *points, *times;
  nsvcd_joint_motion motion;
} cut_motion;

// Cuts a piece in two at a time, unless one would be too short for a proof (de Casteljau).
static void cut_piece(cut_motion *m, size_t joints, double time) {
  const size_t degree = m->motion.degree;
  const size_t pieces = m->motion.pieces;
  const double least = 1e-8 * (m->times[pieces] - m->times[0]);
  size_t piece = 0;
  while (piece + 1 < pieces && m->times[piece + 1] <= time) piece++;
  double *times = m->times + piece;
  double *rows = m->points + piece * degree * joints;
  const double share = (time - times[0]) / (times[1] - times[0]);
  if (!(time - times[0] > least && times[1] - time > least)) return;
  const size_t after = (pieces - piece - 1) * degree + 1;
  memmove(rows + 2 * degree * joints, rows + degree * joints, after * joints * sizeof *rows);
  for (size_t j = 0; j < joints; j++) {
    double p[NSVCD_MAX_DEGREE + 1];
    for (size_t i = 0; i <= degree; i++) p[i] = rows[i * joints + j];
    for (size_t level = 0; level <= degree; level++) {
      rows[level * joints + j] = p[0];
      rows[(2 * degree - level) * joints + j] = p[degree - level];
      for (size_t i = 0; i + level < degree; i++) p[i] += share * (p[i + 1] - p[i]);
    }
  }
  memmove(times + 2, times + 1, (pieces - piece) * sizeof *times);
  times[1] = time;
  m->motion.pieces++;
}

// Until when a pair may touch from the start of a motion on, and from when on up to its end. Returns
// 0 if it may not at all, or after a complaint.
static int allowed_times(const robot_in_room *in, const nsvcd_joint_motion *motion, size_t pair,
                         double *until, double *from) {
  nsvcd_allowance near_end = {pair, motion->points, -1};
  for (size_t k = 0; k < in->scene.allowance_count; k++) {
    const nsvcd_allowance *one = &in->allowances[k];
    if (one->pair == pair && one->distance > near_end.distance) near_end.distance = one->distance;
  }
  if (near_end.distance < 0) return 0;
  nsvcd_result result = nsvcd_allowed_until(in->checker, &near_end, motion, 0, until);
  near_end.joints += motion->pieces * motion->degree * in->scene.joint_count;
  if (!result) result = nsvcd_allowed_until(in->checker, &near_end, motion, 1, from);
  return result ? complain("%s: %s", in->file->path, reason_of(result)) : 1;
}

// The same motion, cut where pairs may touch no more, and where they may again. If it is a single
// configuration, a piece that stays there.
static cut_motion cut_where_allowed(const robot_in_room *in, const nsvcd_joint_motion *motion) {
  const size_t joints = in->scene.joint_count;
  const nsvcd_joint_motion still = {1, 1, NULL, NULL};
  const int is_still = motion->pieces == 0;
  const nsvcd_joint_motion *shape = is_still ? &still : motion;
  const size_t pieces = shape->pieces + 2 * in->scene.pair_count;
  cut_motion out;
  out.points = (double *)allocate((pieces * shape->degree + 1) * joints * sizeof(double));
  out.times = (double *)allocate((pieces + 1) * sizeof(double));
  out.motion = *shape;
  out.motion.points = out.points;
  out.motion.times = out.times;
  for (size_t row = 0; row <= shape->pieces * shape->degree; row++)
    memcpy(out.points + row * joints, motion->points + (is_still ? 0 : row * joints),
           joints * sizeof(double));
  for (size_t p = 0; p <= shape->pieces; p++)
    out.times[p] = shape->times ? shape->times[p] : (double)p;
  for (size_t n = 0; n < in->scene.pair_count; n++) {
    double until, from;
    if (!allowed_times(in, motion, n, &until, &from)) continue;
    cut_piece(&out, joints, until);
    cut_piece(&out, joints, from);
  }
  return out;
}

// Tries to make the certificate of a pair; *bytes is to be freed. Returns 0 after a complaint.
static int try_pair_proof(const robot_in_room *in, const char *id, const nsvcd_joint_motion *motion,
                          size_t pair, size_t visits, uint8_t **bytes, nsvcd_certificate *made) {
  const nsvcd_certify_options options = {NULL, visits};
  const nsvcd_body_pair *parts = &in->scene.pairs[pair];
  const proof_mesh *a = tree_of_part(in, parts->a);
  const proof_mesh *b = a ? tree_of_part(in, parts->b) : NULL;
  if (!b) return 0;
  const size_t size = nsvcd_certify_pair_workspace_size(motion, a->tree, b->tree);
  void *workspace = allocate(size);
  size_t room = 1 << 16;
  nsvcd_result result;
  made->size = 0;
  do {
    if (made->size > room) room = made->size;
    free(*bytes);
    *bytes = (uint8_t *)allocate(room);
    result = nsvcd_certify_pair(in->checker, motion, pair, skeleton_clearance(in, pair), a->tree,
                                b->tree, &options, workspace, size, *bytes, room, made);
  } while (!result && made->size > room);
  free(workspace);
  return result ? complain("%s: %s", id, reason_of(result)) : 1;
}

// Makes it; 0 also if there can be none.
static int make_pair_proof(const robot_in_room *in, const char *id,
                           const nsvcd_joint_motion *motion, size_t pair, size_t visits,
                           uint8_t **bytes, nsvcd_certificate *made) {
  const nsvcd_body_pair *parts = &in->scene.pairs[pair];
  if (!try_pair_proof(in, id, motion, pair, visits, bytes, made)) return 0;
  if (made->verdict == NSVCD_FREE) return 1;
  return complain("%s: no certificate for %s and %s: %s%s", id, robot_name(in, parts->a),
                  robot_name(in, parts->b), nsvcd_verdict_string(made->verdict),
                  made->why == NSVCD_WHY_WORK       ? ", for want of --visits"
                  : made->why == NSVCD_WHY_TOO_NEAR ? ", they come too near each other"
                  : made->why == NSVCD_WHY_OPEN     ? ", one seems to be inside the other"
                                                    : "");
}

// Writes the certificate of a pair, after the pieces, if it may touch in some, between which it is
// one. cut: the motion, cut where pairs may touch. Returns 0 after a complaint.
static int write_pair_proof(const robot_in_room *in, const char *id,
                            const nsvcd_joint_motion *motion, const nsvcd_joint_motion *cut,
                            size_t pair, size_t visits, FILE *out) {
  nsvcd_joint_motion rest = *cut;
  nsvcd_certificate made;
  uint8_t *bytes = NULL;
  double until, from;
  made.size = 0;
  if (allowed_times(in, motion, pair, &until, &from)) {
    size_t first = 0;
    size_t end = cut->pieces;
    while (first < end && cut->times[first + 1] <= until) first++;
    while (end > first && cut->times[end - 1] >= from) end--;
    put_bytes(out, first, 4);
    put_bytes(out, end, 4);
    rest.times += first;
    rest.points += first * cut->degree * in->scene.joint_count;
    rest.pieces = end - first;
  }
  const int good = rest.pieces == 0 || make_pair_proof(in, id, &rest, pair, visits, &bytes, &made);
  if (good) {
    put_bytes(out, made.size, 4);
    if (made.size > 0) fwrite(bytes, 1, made.size, out);
  }
  free(bytes);
  return good;
}

// Writes FOLDER/ID.cert: the motion, and a certificate for each pair of the scene, as
// examples/FORMATS.md has it. motion: NULL: there is none. Where there can be no certificate a file
// that is there goes. Returns 0 after a complaint, also then.
static int write_motion_proof(const robot_in_room *in, const char *folder, size_t task,
                              const nsvcd_joint_motion *motion, size_t visits) {
  const nsvcd_scene *scene = &in->scene;
  const robot_file *file = in->file;
  const char *id = file->tasks[task].id;
  char path[4096];
  const double start = seconds();
  snprintf(path, sizeof path, "%s/%s.cert", folder, id);
  if (!motion) {
    remove(path);
    return complain("%s: not written: no motion is certified", path);
  }
  FILE *out = open_file(path, "wb");
  if (!out) return complain("%s: %s", path, strerror(errno));
  cut_motion cut = cut_where_allowed(in, motion);
  const nsvcd_joint_motion *m = &cut.motion;
  const size_t numbers = (m->pieces * m->degree + 1) * scene->joint_count;
  fputs("NSVM", out);
  put_bytes(out, m->pieces, 4);
  put_bytes(out, m->degree, 4);
  put_bytes(out, scene->joint_count, 4);
  for (size_t p = 0; p <= m->pieces; p++) put_double(out, m->times[p]);
  for (size_t k = 0; k < numbers; k++) put_double(out, m->points[k]);
  for (size_t k = 0; k < file->change_count; k++)
    if (file->changes[k].task == task) put_pose(out, &file->changes[k].pose);
  put_bytes(out, scene->pair_count, 4);
  int good = 1;
  for (size_t n = 0; n < scene->pair_count && good; n++)
    good = write_pair_proof(in, id, motion, m, n, visits, out);
  free(cut.points);
  free(cut.times);
  const long size = ftell(out);
  const int is_proven = good;
  good = close_written(out, path) && good;
  if (!good) remove(path);
  if (!is_proven) complain("%s: not written", path);
  if (good)
    fprintf(stderr, PROGRAM ": %s: certificates of %zu pairs, %ld bytes, in %.0f ms\n", path,
            scene->pair_count, size, 1e3 * (seconds() - start));
  return good;
}

// ---- of two bodies that never meet

#define NEVER_BOXES 100000  // that are tried
#define NEVER_DEPTH 128     // of cuts
#define NEVER_VISITS 20000  // for each box, unless --visits says otherwise
#define NEVER_SWEPT 0.25    // the share of the joint that is swept along, when a box is cut
#define NEVER_TRAVEL 2e-5   // metres: a box in which points move by less is not cut

// Writes the proof of a box (2, joints) of values, of a pair of the scene, if there is one. *cut: else,
// the joint to cut it along; NSVCD_NONE: none is left. Returns 0 after a complaint.
static int write_box(const robot_in_room *in, const char *id, const double *box, size_t pair,
                     size_t visits, size_t *cut, FILE *out) {
  const size_t joints = in->scene.joint_count;
  double moved[NSVCD_MAX_JOINTS], points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion sweep = {1, 1, points, NULL};
  nsvcd_certificate made;
  uint8_t *bytes = NULL;
  size_t swept = 0;
  double travel = 0;
  const nsvcd_result result =
      nsvcd_pair_travel(in->checker, in->scene.pairs[pair], box, box + joints, moved);
  if (result) return complain("%s: %s", id, reason_of(result));
  for (size_t j = 0; j < joints; j++) {
    points[j] = points[joints + j] = 0.5 * (box[j] + box[joints + j]);
    if (moved[j] > moved[swept]) swept = j;
    travel += moved[j];
  }
  points[swept] = box[swept];
  points[joints + swept] = box[joints + swept];
  const double others = travel - moved[swept];
  const size_t most = visits || others <= NEVER_TRAVEL ? visits : NEVER_VISITS;
  in->clearances[pair] = (float)(others * (1 + 1e-6));
  if (!try_pair_proof(in, id, &sweep, pair, most, &bytes, &made)) {
    free(bytes);
    return 0;
  }
  const int is_free = made.verdict == NSVCD_FREE;
  *cut = NSVCD_NONE;
  moved[swept] *= NEVER_SWEPT;
  for (size_t j = 0; j < joints && !is_free && others > NEVER_TRAVEL; j++)
    if (moved[j] > (*cut == NSVCD_NONE ? 0 : moved[*cut])) *cut = j;
  if (is_free || *cut != NSVCD_NONE) put_bytes(out, is_free ? swept : 128 + *cut, 1);
  if (is_free) {
    uint32_t bits;
    memcpy(&bits, &in->clearances[pair], sizeof bits);
    put_bytes(out, bits, 4);
    put_bytes(out, made.size, 4);
    fwrite(bytes, 1, made.size, out);
  }
  free(bytes);
  *cut = is_free ? joints : *cut;
  return 1;
}

// Writes a name to `to` at *at, so that no two pairs A-B are written alike: with %2d for -, %2f for /,
// %2c for a comma and %25 for %.
static void put_name(char *to, size_t capacity, size_t *at, const char *name) {
  for (; *name && *at + 4 < capacity; name++) {
    const int is_plain = !strchr("-/,%", *name);
    if (!is_plain) snprintf(to + *at, 4, "%%%02x", (unsigned)(unsigned char)*name);
    if (is_plain) to[*at] = *name;
    *at += is_plain ? 1 : 3;
    to[*at] = 0;
  }
}

// Writes FOLDER/A-B.cert, of a pair of the scene that never meets: boxes of values of the joints, cut
// until each has a proof, or until `limit` seconds have passed. Returns 0 after a complaint.
static int write_never_proof(const robot_in_room *in, const char *folder, size_t pair,
                             size_t visits, double limit) {
  const size_t joints = in->scene.joint_count;
  char path[4096];
  size_t height = 1;
  size_t boxes = 0;
  size_t cut = 0;
  int is_late = 0;
  const double start = seconds();
  size_t at = (size_t)snprintf(path, sizeof path / 2, "%s/", folder);
  put_name(path, sizeof path - 8, &at, robot_name(in, in->scene.pairs[pair].a));
  path[at++] = '-';
  put_name(path, sizeof path - 8, &at, robot_name(in, in->scene.pairs[pair].b));
  strcpy(path + at, ".cert");
  FILE *out = open_file(path, "wb");
  if (!out) return complain("%s: %s", path, strerror(errno));
  double *stack = (double *)allocate(NEVER_DEPTH * 2 * joints * sizeof *stack);
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &in->scene.joints[j];
    const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
    stack[j] = is_endless ? 0 : joint->low;
    stack[joints + j] = is_endless ? 6.28318530717960 : joint->high;
  }
  fputs("NSVN", out);
  int good = 1;
  while (height > 0 && good && cut != NSVCD_NONE) {
    double *box = stack + (height - 1) * 2 * joints;
    good = write_box(in, path, box, pair, visits, &cut, out);
    is_late = height > 1 && seconds() - start > limit;
    if (++boxes == NEVER_BOXES || height == NEVER_DEPTH || is_late) cut = NSVCD_NONE;
    if (!good || cut == NSVCD_NONE) break;
    height--;
    if (cut == joints) continue;
    const double middle = 0.5 * (box[cut] + box[joints + cut]);
    memcpy(box + 2 * joints, box, 2 * joints * sizeof *box);
    box[cut] = box[3 * joints + cut] = middle;
    height += 2;
  }
  free(stack);
  const long size = ftell(out);
  good = close_written(out, path) && good;
  if (good && cut == NSVCD_NONE)
    good = complain(
        "%s: not written: %s", path,
        is_late ? "for want of --seconds" : "too near, or for want of --visits or of boxes");
  if (!good) remove(path);
  if (good)
    fprintf(stderr, PROGRAM ": %s: %zu boxes, %ld bytes, in %.0f ms\n", path, boxes, size,
            1e3 * (seconds() - start));
  return good;
}
#endif  // NSVCD_SCENERY_CERTIFICATES_H
