// bench_world.c - what a game pays: casts in a level, a body that rests on it, by what is asked, and
// frames of a world.
//
//   build/bench_world casts     first contacts to 1 mm, of movers from a ray to a concave prop
//   build/bench_world rest      props at rest on a level: one question, by its options
//   build/bench_world frames [MOVERS [FRAMES]]   movers of 12 to 1,000 triangles and more fall on a
//                               level and slide on it: milliseconds a frame, of the processor
//
// The level has 139,080 triangles. Exit status 1 if bodies overlap, by an oracle in double.
#define _POSIX_C_SOURCE 200112L
#include <time.h>

#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../../extras/neuralsvcd_world.h"
#define PROGRAM "bench_world"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/level.h"
#include "../../examples/scenery/oracle.h"
#include "../../examples/scenery/poses.h"
#include "../body_of.h"
#include "meter.h"

#define SIDE 20.0
#define TRIANGLES 139080
#define ASKED 300
#define RUNS 5
enum { PROPS = 10 };

typedef struct bench {
  shapes_mesh mesh, props[PROPS];
  const nsvcd_body *level, *bodies[PROPS];
  void *workspace;
  size_t size;
} bench;

static void begin(bench *b) {
  memset(b, 0, sizeof *b);
  b->size = nsvcd_sweep_workspace_size(NULL);
  b->workspace = allocate(b->size);
  level_make(&b->mesh, SIDE, TRIANGLES, 1);
  b->level = body_of(&b->mesh, NULL);
  shapes_mug(&b->props[0], 0.06, 0.13, 0.008, 32);
  shapes_bowl(&b->props[1], 0.16, 0.09, 0.012, 32);
  shapes_box(&b->props[2], 0.24, 0.18, 0.2, 1);
  shapes_chair(&b->props[3], 0.24, 0.5, 0.03);
  shapes_bottle(&b->props[4], 0.06, 0.28, 24);
  shapes_gear(&b->props[5], 0.14, 0.03, 0.06, 20);
  shapes_drawer(&b->props[6], 0.3, 0.2, 0.12, 0.015);
  shapes_torus(&b->props[7], 0.12, 0.04, 32, 16);
  shapes_l_bracket(&b->props[8], 0.24, 0.3, 0.06, 0.12);
  level_boulder(&b->props[9], 0.14, 12, 1);
  for (int k = 0; k < PROPS; k++) {
    double low[3], high[3];
    shapes_bounds(&b->props[k], low, high);
    shapes_place(&b->props[k], 0, NULL, -0.5 * (low[0] + high[0]), -0.5 * (low[1] + high[1]),
                 -0.5 * (low[2] + high[2]));
    b->bodies[k] = body_of(&b->props[k], NULL);
  }
}

static nsvcd_pose pose_at(double x, double y, double z, const double *q) {
  nsvcd_pose out;
  memset(&out, 0, sizeof out);
  out.position[0] = (float)x;
  out.position[1] = (float)y;
  out.position[2] = (float)z;
  out.rotation[3] = 1;
  for (int k = 0; k < 4 && q; k++) out.rotation[k] = (float)q[k];
  return out;
}

static double microseconds(const bench *b, const nsvcd_question *q, nsvcd_answer *answer) {
  double best = 1e9;
  for (int run = 0; run < RUNS; run++) {
    const double start = seconds();
    if (nsvcd_sweep(q, b->workspace, b->size, answer)) exit(REFUSED);
    best = fmin(best, 1e6 * (seconds() - start));
  }
  return best;
}

static void print_times(const char *name, double *times, size_t count, double more) {
  double sum = 0;
  for (size_t k = 0; k < count; k++) sum += times[k];
  meter_sort(times, count);
  printf("  %-36s median %6.1f  mean %6.1f  99 %% %6.1f  worst %6.1f us  %5.1f\n", name,
         times[count / 2], sum / (double)count, times[count * 99 / 100], times[count - 1], more);
}

// ------------------------------------------------------------------------------------------ casts

typedef struct cast {
  const char *name;
  const nsvcd_body *body;
  double least_way, most_way, turn;  // metres, radians
} cast;

// A way of the body from a place where it is free.
static void draw_cast(const bench *b, const cast *c, shapes_rng *rng, nsvcd_pose path[2]) {
  const double radius = (double)nsvcd_body_describe(c->body).radius;
  nsvcd_answer answer;
  do {
    nsvcd_question q;
    double way[3], turn[4];
    const double x = shapes_uniform(rng, -9, 9);
    const double y = shapes_uniform(rng, -9, 9);
    const double z = level_height(x, y) + shapes_uniform(rng, 0, 0.1) + radius;
    const double length = shapes_uniform(rng, c->least_way, c->most_way);
    shapes_direction(rng, way);
    shapes_quaternion(rng, turn);
    path[0] = path[1] = pose_at(x, y, z, c->turn > 0 ? turn : NULL);
    for (int k = 0; k < 3; k++) path[1].position[k] += (float)((k < 2 ? 1 : 0.5) * length * way[k]);
    if (c->turn > 0) {
      double to[4] = {0, 0, sin(0.5 * c->turn), cos(0.5 * c->turn)}, by[4];
      oracle_quat_mul(to, turn, by);
      for (int k = 0; k < 4; k++) path[1].rotation[k] = (float)by[k];
    }
    memset(&q, 0, sizeof q);
    q.a.body = c->body;
    q.a.poses = path;
    q.a.count = 1;
    q.b.body = b->level;
    if (nsvcd_sweep(&q, b->workspace, b->size, &answer)) exit(REFUSED);
  } while (answer.verdict != NSVCD_FREE);
}

// Microseconds of its first contact.
static double ask_cast(const bench *b, const cast *c, const nsvcd_pose path[2],
                       nsvcd_answer *answer) {
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  q.a.body = c->body;
  q.a.poses = path;
  q.a.count = 2;
  q.b.body = b->level;
  q.ask = NSVCD_ASK_FIRST;
  q.to = 1e-3f;
  return microseconds(b, &q, answer);
}

static void print_cast(const bench *b, const cast *c) {
  static double times[ASKED];
  shapes_rng rng = {7};
  size_t hits = 0;
  for (size_t k = 0; k < ASKED; k++) {
    nsvcd_answer answer;
    nsvcd_pose path[2];
    draw_cast(b, c, &rng, path);
    times[k] = ask_cast(b, c, path, &answer);
    hits += answer.verdict == NSVCD_HIT;
  }
  print_times(c->name, times, ASKED, 100.0 * (double)hits / ASKED);
}

enum { CASTS = 6 };

static void make_casts(const bench *b, cast *casts) {
  static const float ends[2][3] = {{0, 0, -0.6f}, {0, 0, 0.6f}};
  static const float half[3] = {0.25f, 0.25f, 0.25f};
  static const float plank[3] = {0.6f, 0.06f, 0.02f};
  const cast all[CASTS] = {{"ray of 1 mm, 2 to 20 m", NULL, 2, 20, 0},
                           {"sphere of 0.1 m, 0.1 to 1 m", NULL, 0.1, 1, 0},
                           {"capsule of 1.8 m, 1 to 10 cm", NULL, 0.01, 0.1, 0},
                           {"box of 0.5 m, 1 to 10 cm", NULL, 0.01, 0.1, 0},
                           {"turning plank of 1.2 m, to 10 cm", NULL, 0.01, 0.1, 0.2},
                           {"chair that turns, 1 to 10 cm", b->bodies[3], 0.01, 0.1, 0.2}};
  memcpy(casts, all, sizeof all);
  if (nsvcd_encode_sphere(5e-4f, NULL, &casts[0].body) ||
      nsvcd_encode_sphere(0.05f, NULL, &casts[1].body) ||
      nsvcd_encode_capsule(ends[0], ends[1], 0.3f, NULL, &casts[2].body) ||
      nsvcd_encode_box(half, 0, NULL, &casts[3].body) ||
      nsvcd_encode_box(plank, 0, NULL, &casts[4].body))
    exit(REFUSED);
}

static void print_casts(const bench *b) {
  cast casts[CASTS];
  make_casts(b, casts);
  printf("first contacts to 1 mm; the last column: of 100, how many hit\n");
  for (int k = 0; k < CASTS; k++) print_cast(b, &casts[k]);
  for (int k = 0; k < CASTS - 1; k++) nsvcd_body_free(casts[k].body, NULL);
}

// ------------------------------------------------------------------------------------------- rest

typedef struct asked {
  const char *name;
  nsvcd_ask ask;
  float clearance, slop;
  int manifold, rests;
} asked;

static void print_rest(const bench *b) {
  static const asked all[] = {
      {"falls: does it hit", NSVCD_ASK_HIT, 0, 0, 0, 0},
      {"falls: first", NSVCD_ASK_FIRST, 0, 0, 0, 0},
      {"falls: first, clearance", NSVCD_ASK_FIRST, 5e-4f, 0, 0, 0},
      {"falls: first, clearance, manifold", NSVCD_ASK_FIRST, 5e-4f, 0, 1, 0},
      {"falls: first, clearance, slop", NSVCD_ASK_FIRST, 5e-4f, 1e-3f, 0, 0},
      {"falls: all of these", NSVCD_ASK_FIRST, 5e-4f, 1e-3f, 1, 0},
      {"rests: is it free, clearance", NSVCD_ASK_HIT, 5e-4f, 0, 0, 1}};
  static nsvcd_pose rests[ASKED];
  static double times[ASKED];
  shapes_rng rng = {11};
  nsvcd_answer answer;
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  q.b.body = b->level;
  for (size_t k = 0; k < ASKED;) {
    double turn[4];
    const double x = shapes_uniform(&rng, -9, 9);
    const double y = shapes_uniform(&rng, -9, 9);
    shapes_quaternion(&rng, turn);
    const nsvcd_pose way[2] = {pose_at(x, y, level_height(x, y) + 1, turn),
                               pose_at(x, y, level_height(x, y) - 1, turn)};
    q.a.body = b->bodies[k % PROPS];
    q.a.poses = way;
    q.a.count = 2;
    q.ask = NSVCD_ASK_FIRST;
    q.to = 5e-5f;
    q.clearance = 5e-4f;
    if (nsvcd_sweep(&q, b->workspace, b->size, &answer)) exit(REFUSED);
    if (answer.verdict == NSVCD_HIT && answer.time.low > 0) rests[k++] = answer.safe.a;
  }
  printf(
      "props half a millimetre above a level, by 2.7 mm down or at rest; the last column: "
      "units\n");
  for (size_t n = 0; n <= sizeof all / sizeof *all; n++) {
    const int is_contacts = n == sizeof all / sizeof *all;
    const asked *a = &all[is_contacts ? n - 1 : n];
    double units = 0;
    for (size_t k = 0; k < ASKED; k++) {
      nsvcd_pose way[2] = {rests[k], rests[k]};
      way[1].position[2] -= a->rests ? 0 : 2.7e-3f;
      memset(&q, 0, sizeof q);
      q.a.body = b->bodies[k % PROPS];
      q.a.poses = way;
      q.a.count = a->rests ? 1 : 2;
      q.b.body = b->level;
      q.ask = a->ask;
      q.to = a->ask == NSVCD_ASK_FIRST ? 5e-5f : 0;
      q.clearance = is_contacts ? 1.5e-3f : a->clearance;
      q.slop = a->slop;
      q.manifold = a->manifold;
      if (!is_contacts) times[k] = microseconds(b, &q, &answer);
      for (int run = 0; run < RUNS && is_contacts; run++) {
        nsvcd_contact found[NSVCD_MAX_SIDES * NSVCD_MAX_CONTACTS];
        size_t count;
        const double start = seconds();
        if (nsvcd_contacts(&q, b->workspace, b->size, found, 24, &count, NULL)) exit(REFUSED);
        const double taken = 1e6 * (seconds() - start);
        times[k] = run ? fmin(times[k], taken) : taken;
      }
      units += is_contacts ? 0 : (double)answer.work / ASKED;
    }
    print_times(is_contacts ? "rests: contacts within 1.5 mm" : a->name, times, ASKED, units);
  }
}

// ----------------------------------------------------------------------------------------- frames

static size_t overlaps_of(const nsvcd_world *world, const oracle_mesh *exact, size_t movers) {
  size_t found = 0;
  size_t pair_count;
  nsvcd_body_pair *pairs = (nsvcd_body_pair *)allocate(64 * (movers + 1) * sizeof *pairs);
  if (nsvcd_world_pairs(world, 0, pairs, 64 * (movers + 1), &pair_count)) exit(REFUSED);
  for (size_t k = 0; k < pair_count && k < 64 * (movers + 1); k++) {
    nsvcd_world_body one, other;
    if (nsvcd_world_get(world, pairs[k].a, &one) || nsvcd_world_get(world, pairs[k].b, &other))
      exit(REFUSED);
    const oracle_pose at = pose_widened(&one.pose);
    const oracle_pose there = pose_widened(&other.pose);
    oracle_search search;
    // ids begin at 1 and were given in order: the level first
    oracle_search_begin(&search, &exact[pairs[k].a - 1], &exact[pairs[k].b - 1]);
    found += !(oracle_search_run(&search, &at, &there, 1e-4) > 0);
  }
  free(pairs);
  return found;
}

static int is_free(const bench *b, const nsvcd_world *world, size_t id) {
  nsvcd_world_question q;
  nsvcd_world_answer answer;
  memset(&q, 0, sizeof q);
  q.self = id;
  q.question.clearance = 0.001f;
  if (nsvcd_world_sweep(world, &q, b->workspace, b->size, &answer)) exit(REFUSED);
  return answer.verdict == NSVCD_FREE;
}

// Movers above a level, and what they are.
typedef struct scene {
  void *memory;
  nsvcd_world *world;
  size_t movers;
  nsvcd_world_mover *all;
  oracle_mesh *exact;  // by id - 1
} scene;

static void set_mover(const bench *b, scene *s, size_t k, shapes_rng *rng) {
  const shapes_mesh *mesh = &b->props[k % PROPS];
  const size_t side = (size_t)ceil(sqrt((double)s->movers));
  const double step = fmin(0.7, (SIDE - 3) / (double)side);
  const double x = step * ((double)(k % side) - 0.5 * (double)(side - 1));
  const double y = step * ((double)(k / side) - 0.5 * (double)(side - 1));
  double turn[4], low[3], high[3];
  nsvcd_world_body body;
  shapes_quaternion(rng, turn);
  memset(&body, 0, sizeof body);
  body.body = b->bodies[k % PROPS];
  body.pose = pose_at(x, y, level_height(x, y) + 1.6 + 0.6 * (double)(k % 3), turn);
  if (nsvcd_world_add(s->world, &body, &s->all[k].id)) exit(REFUSED);
  for (int tries = 0; tries < 100 && !is_free(b, s->world, s->all[k].id); tries++) {
    body.pose.position[2] += 0.1f;
    if (nsvcd_world_move(s->world, s->all[k].id, &body.pose)) exit(REFUSED);
  }
  if (!oracle_mesh_init(&s->exact[k + 1], mesh->positions, mesh->vertices, mesh->indices,
                        mesh->triangles, 1))
    exit(REFUSED);
  shapes_bounds(mesh, low, high);
  nsvcd_slide_options *o = &s->all[k].how;
  for (int i = 0; i < 3; i++) {
    const double u = high[(i + 1) % 3] - low[(i + 1) % 3];
    const double v = high[(i + 2) % 3] - low[(i + 2) % 3];
    o->inertia[i] = (float)(fmax(u * u + v * v, 1e-3) / 12);
  }
  o->mass = 1;
  o->friction = 0.5f;
  o->clearance = o->margin = 0.001f;
}

static void scene_begin(const bench *b, size_t movers, scene *s) {
  const size_t size = nsvcd_world_size(movers + 1);
  shapes_rng rng = {13};
  size_t level;
  nsvcd_world_body body;
  s->movers = movers;
  s->memory = allocate(size);
  s->all = (nsvcd_world_mover *)allocate(movers * sizeof *s->all);
  s->exact = (oracle_mesh *)allocate((movers + 1) * sizeof *s->exact);
  memset(s->all, 0, movers * sizeof *s->all);
  if (nsvcd_world_begin(s->memory, size, movers + 1, &s->world)) exit(REFUSED);
  memset(&body, 0, sizeof body);
  body.body = b->level;
  body.pose.rotation[3] = 1;
  body.fixed = 1;
  if (nsvcd_world_add(s->world, &body, &level)) exit(REFUSED);
  if (!oracle_mesh_init(&s->exact[0], b->mesh.positions, b->mesh.vertices, b->mesh.indices,
                        b->mesh.triangles, 1))
    exit(REFUSED);
  for (size_t k = 0; k < movers; k++) set_mover(b, s, k, &rng);
}

static void scene_end(scene *s) {
  for (size_t k = 0; k <= s->movers; k++) oracle_mesh_free(&s->exact[k]);
  free(s->memory);
  free(s->all);
  free(s->exact);
}

// Of the processor: frames are not asked twice, and others may use the machine.
static double busy_seconds(void) {
  struct timespec now;
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now)) exit(REFUSED);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static size_t print_frames(const bench *b, size_t movers, size_t frames) {
  const nsvcd_step_options options = {{0, 0, -9.81f}, 0, 0};
  nsvcd_step_answer answer;
  scene s;
  double *times = (double *)allocate(frames * sizeof *times);
  double sum = 0;
  size_t questions = 0;
  scene_begin(b, movers, &s);
  for (size_t frame = 0; frame < frames; frame++) {
    const double start = busy_seconds();
    if (nsvcd_world_step(s.world, s.all, movers, &options, 1.0f / 60, b->workspace, b->size,
                         &answer))
      exit(REFUSED);
    times[frame] = 1e3 * (busy_seconds() - start);
    sum += times[frame];
    questions += answer.questions;
  }
  const double last = times[frames - 1];
  meter_sort(times, frames);
  size_t below = 0;
  for (size_t k = 0; k < movers; k++) {
    const float *at = s.all[k].answer.pose.position;
    below += (double)at[2] < level_height((double)at[0], (double)at[1]);
  }
  const size_t overlaps = overlaps_of(s.world, s.exact, movers);
  printf(
      "%zu movers, %zu frames: median %.2f  mean %.2f  99 %% %.2f  worst %.2f  last %.2f ms; %.1f "
      "questions a frame; %zu sleep at the end, %zu overlap, %zu are below the level\n",
      movers, frames, times[frames / 2], sum / (double)frames, times[frames * 99 / 100],
      times[frames - 1], last, (double)questions / (double)frames, answer.asleep, overlaps, below);
  scene_end(&s);
  free(times);
  return overlaps;
}

static void end(bench *b) {
  for (int k = 0; k < PROPS; k++) {
    nsvcd_body_free(b->bodies[k], NULL);
    shapes_free(&b->props[k]);
  }
  nsvcd_body_free(b->level, NULL);
  shapes_free(&b->mesh);
  free(b->workspace);
}

#ifndef WORLD_PEERS  // world_peers.cc has a main of its own
int main(int argc, char **argv) {
  static bench b;
  size_t overlaps = 0;
  const char *what = argc > 1 ? argv[1] : "";
  begin(&b);
  if (!*what || !strcmp(what, "casts")) print_casts(&b);
  if (!*what || !strcmp(what, "rest")) print_rest(&b);
  if (!*what || !strcmp(what, "frames")) {
    const size_t frames = argc > 3 ? (size_t)strtoul(argv[3], NULL, 10) : 300;
    if (argc > 2) overlaps += print_frames(&b, (size_t)strtoul(argv[2], NULL, 10), frames);
    if (argc <= 2) overlaps += print_frames(&b, 50, frames) + print_frames(&b, 1000, frames);
  }
  end(&b);
  return overlaps ? REFUSED : DONE;
}
#endif
