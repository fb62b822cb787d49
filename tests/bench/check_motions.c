// check_motions.c - holds what the proof says of the problems of a file, both bodies moving or one,
// against conservative advancement in double: do they come closer than a clearance, and when first?
//
//   build/check_motions FILE [CLEARANCE [FIRST]]     metres, share of the motion
//
// Exit status 1 if there is a false stop or a miss, or a contact at another time. Problems whose
// least distance is within 0.1 mm of the clearance are not counted, but for what is said of them
// being false beyond doubt.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "check_motions"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/oracle.h"
#include "../../examples/scenery/poses.h"
#include "../../examples/scenery/status_of.h"

#define HAIR 1e-6    // metres: nearer than this to the clearance, advancement stops
#define MARGIN 1e-4  // metres
#define MOST_POSES 256

typedef struct track {
  oracle_pose poses[MOST_POSES];
  size_t count;
  double reach;  // of the body, from its origin
} track;

static void read_track(const nsvcd_mover *mover, const oracle_mesh *mesh, track *out) {
  out->count = mover->count;
  out->reach = oracle_length(mesh->center) + mesh->radius;
  for (size_t i = 0; i < mover->count; i++) out->poses[i] = pose_widened(&mover->poses[i]);
}

// How fast a point may be from t until the next pose, at *next.
static double rate_at(const track *m, double t, double *next) {
  const double arcs = (double)(m->count - 1);
  double moved[3], axis[3];
  *next = 1;
  if (m->count < 2) return 0;
  const size_t k = (size_t)(t * arcs) < m->count - 2 ? (size_t)(t * arcs) : m->count - 2;
  oracle_sub(m->poses[k + 1].position, m->poses[k].position, moved);
  *next = (double)(k + 1) / arcs;
  const double turn = oracle_quat_arc(m->poses[k].rotation, m->poses[k + 1].rotation, axis);
  return (oracle_length(moved) + m->reach * turn) * arcs;
}

typedef struct scene {
  oracle_mesh *meshes[2];
  track tracks[2];
} scene;

static double distance_at(const scene *s, double t) {
  const oracle_pose a = oracle_pose_at(s->tracks[0].poses, s->tracks[0].count, t);
  const oracle_pose b = oracle_pose_at(s->tracks[1].poses, s->tracks[1].count, t);
  return oracle_distance(s->meshes[0], &a, s->meshes[1], &b, NULL, NULL);
}

// The first time at which the distance is within a hair of `clearance`; 2 if there is none.
static double first_approach(const scene *s, double clearance) {
  for (double t = 0;;) {
    double next[2];
    const double room = distance_at(s, t) - clearance;
    if (room <= HAIR) return t;
    if (t >= 1) return 2;
    const double rate = rate_at(&s->tracks[0], t, &next[0]) + rate_at(&s->tracks[1], t, &next[1]);
    const double until = fmin(next[0], next[1]);
    const double step = rate > 0 ? room / rate : 1;
    t = fmin(t + step < until ? t + step : until + (until < 1 ? 1e-15 : 0), 1);
  }
}

typedef struct tally {
  size_t problems, hits, free, close, undecided, stops, misses, late, blurred;
  double worst;
} tally;

// One problem, asked and followed. quanta: what triangles may be off by, 0 but for coarse bodies; a
// contact is one to within some of that, and rounding.
static void check_one(const problem *p, const nsvcd_answer *answer, const scene *s,
                      double clearance, double first, double quanta, tally *sum) {
  const int one_inside = oracle_inside(s->meshes[0], &s->tracks[0].poses[0], s->meshes[1],
                                       &s->tracks[1].poses[0]) > 0.5 ||
                         oracle_inside(s->meshes[1], &s->tracks[1].poses[0], s->meshes[0],
                                       &s->tracks[0].poses[0]) > 0.5;
  // 2: they do not come that close
  const double sure = one_inside ? 0 : first_approach(s, clearance - MARGIN);
  const double maybe = one_inside ? 0 : first_approach(s, clearance + MARGIN);  // 2: not even that
  const int hits = clearance > MARGIN ? sure <= 1 : one_inside || first_approach(s, 0) <= 1;
  const int is_free = maybe > 1;
  sum->problems++;
  sum->hits += hits && !is_free;
  sum->free += is_free;
  sum->close += !hits && !is_free;
  sum->undecided += answer->verdict == NSVCD_UNDECIDED;
  if (is_free && collides_of(answer)) sum->stops++;
  if (clearance > MARGIN && hits && !collides_of(answer)) sum->misses++;
  if (is_free && collides_of(answer))
    printf("%s: stopped at %g, but free\n", p->id, (double)contact_time_of(answer));
  if (clearance > MARGIN && hits && !collides_of(answer))
    printf("%s: hits at %g, missed\n", p->id, sure);
  if (!(first > 0) || answer->inside || one_inside) return;
  // Before time.low nothing is closer than the clearance; at the contact something is, soon after.
  const double until = (double)answer->time.low;
  const double when = (double)contact_time_of(answer);
  const double early = first_approach(s, fmax(clearance - 2 * HAIR, 0));
  int wrong = early < until - 1e-6 && distance_at(s, early) < clearance - 3 * HAIR;
  if (answer->verdict == NSVCD_HIT) {
    // later than that only after surfaces that were nearer than can be told
    const int late = when - until > first * 1.0001 + 1e-6;
    sum->blurred += late;
    if (!late) sum->worst = fmax(sum->worst, (when - until) / first);
    const double high = (double)answer->distance.high;
    wrong |= late && distance_at(s, until) > clearance + 4 * quanta + HAIR;
    // told as a float, as the clearance was
    wrong |= high > clearance * (1 + 2e-6) + 4 * quanta + 1e-11;
    wrong |= distance_at(s, when) > high + HAIR;
  }
  sum->late += wrong != 0;
  if (wrong)
    printf("%s: first contact %g, proven free until %g, but near at %g\n", p->id, when, until,
           early);
}

int main(int argc, char **argv) {
  problem_file file;
  tally sum;
  memset(&sum, 0, sizeof sum);
  if (argc < 2 || argc > 4) return complain("FILE [CLEARANCE [FIRST]]"), USAGE;
  const double clearance = argc > 2 ? atof(argv[2]) : 0;
  const double first = argc > 3 ? atof(argv[3]) : 0;
  if (!read_problems(argv[1], &file)) return REFUSED;
  nsvcd_mesh *meshes = (nsvcd_mesh *)allocate(file.mesh_count * sizeof *meshes);
  const nsvcd_body **bodies = (const nsvcd_body **)allocate(file.mesh_count * sizeof *bodies);
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  const char *slash = strrchr(argv[1], '/');
  for (size_t i = 0; i < file.mesh_count; i++) {
    char path[4096];
    const int folder = file.meshes[i].path[0] == '/' || !slash ? 0 : (int)(slash - argv[1]) + 1;
    snprintf(path, sizeof path, "%.*s%s", folder, argv[1], file.meshes[i].path);
    nsvcd_result result = nsvcd_obj_load(path, NULL, &meshes[i], NULL);
    if (!result) result = nsvcd_encode(&meshes[i], NULL, NULL, NULL, 0, &bodies[i]);
    if (result) return complain("%s: %s", path, nsvcd_result_string(result)), REFUSED;
  }
  for (size_t i = 0; i < file.problem_count; i++) {
    const problem *p = &file.problems[i];
    nsvcd_question question = question_of_problem(&file, p);
    nsvcd_answer answer;
    scene s;
    if (question.a.count > MOST_POSES || question.b.count > MOST_POSES) continue;
    question.a.body = bodies[p->moving];
    question.b.body = bodies[p->fixed];
    question.clearance = (float)clearance;
    question.ask = first > 0 ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
    question.to_time = (float)first;
    const nsvcd_result result =
        nsvcd_sweep(&question, workspace, nsvcd_sweep_workspace_size(NULL), &answer);
    if (result) return complain("%s: %s", p->id, nsvcd_result_string(result)), REFUSED;
    for (int side = 0; side < 2; side++) {
      const nsvcd_mesh *mesh = &meshes[side ? p->fixed : p->moving];
      const nsvcd_mover *mover = side ? &question.b : &question.a;
      double *positions = (double *)allocate(3 * mesh->vertex_count * sizeof *positions);
      for (size_t k = 0; k < 3 * mesh->vertex_count; k++) positions[k] = (double)mesh->positions[k];
      s.meshes[side] = (oracle_mesh *)allocate(sizeof *s.meshes[side]);
      if (!oracle_mesh_init(s.meshes[side], positions, mesh->vertex_count, mesh->indices,
                            mesh->triangle_count, (double)mover->scale)) {
        return complain("out of memory"), REFUSED;
      }
      free(positions);
      read_track(mover, s.meshes[side], &s.tracks[side]);
    }
    const double quanta =
        (double)(question.a.scale * nsvcd_body_describe(question.a.body).quantization_error +
                 question.b.scale * nsvcd_body_describe(question.b.body).quantization_error);
    check_one(p, &answer, &s, clearance, first, quanta, &sum);
    for (int side = 0; side < 2; side++) {
      oracle_mesh_free(s.meshes[side]);
      free(s.meshes[side]);
    }
  }
  printf(
      "%zu problems: %zu come closer than %g m, %zu do not, %zu too close to call; %zu false "
      "stops, %zu misses, "
      "%zu undecided",
      sum.problems, sum.hits, clearance, sum.free, sum.close, sum.stops, sum.misses, sum.undecided);
  if (first > 0)
    printf(
        "; %zu contacts at another time, %zu after a doubt, else late by %.3f of the tolerance at "
        "most",
        sum.late, sum.blurred, sum.worst);
  printf("\n");
  for (size_t i = 0; i < file.mesh_count; i++) {
    nsvcd_body_free(bodies[i], NULL);
    nsvcd_mesh_free(&meshes[i], NULL);
  }
  free(meshes);
  free(bodies);
  free(workspace);
  free_problems(&file);
  return sum.stops || sum.misses || sum.late ? 1 : 0;
}
