// bench_level.c - a level as one body: what it takes to encode, and what the motions of a frame against it cost beside the
// same question about its local piece, that which the motion can reach, cut out and encoded by itself. Every verdict is
// held against the oracle.
//
//   build/bench_level TRIANGLES [MOTIONS [POINTS]]    a level of 20 m; N: 0, the default
//
// Sets: `near`, at random places and in all directions, half of them hits or so; `slide`, along the ground at some tenths
// of a millimetre to some millimetres; `dash`, ten frames' way in one. Exit status 1 if a verdict is wrong.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "../examples/level.h"
#include "oracle.h"

#define SIDE 20.0       // metres
#define RUNS 5          // times that each question is asked; the shortest counts
#define MARGIN 1e-4     // metres: nearer to contact than this the oracle's label is not counted
#define REACH 0.05      // metres by which the local piece is larger than what the motion can reach
#define BODIES 6

enum { NEAR, SLIDE, DASH, SETS };
static const char *const set_names[SETS] = {"near", "slide", "dash"};

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void fail(const char *what) {
  fprintf(stderr, "bench_level: %s\n", what);
  exit(2);
}

// ---- memory that is counted

typedef struct heap {
  size_t now, most;
} heap;

static void *heap_alloc(size_t size, void *user) {
  heap *h = (heap *)user;
  size_t *memory = (size_t *)malloc(size + 16);
  if (!memory) return NULL;
  memory[0] = size;
  h->now += size;
  h->most = h->now > h->most ? h->now : h->most;
  return memory + 2;
}
static void heap_free(void *memory, void *user) {
  heap *h = (heap *)user;
  if (!memory) return;
  h->now -= ((size_t *)memory)[-2];
  free((size_t *)memory - 2);
}

// ---- meshes

typedef struct solid {
  nsvcd_mesh mesh;
  oracle_mesh oracle;
  const nsvcd_body *body;
  double radius;  // from the origin
} solid;

// Positions are rounded to float first, so that library and oracle see the same mesh.
static void solid_init(solid *s, shapes_mesh *shape, double extent) {
  if (extent > 0) shapes_fit(shape, extent);
  s->mesh.vertex_count = shape->vertices;
  s->mesh.triangle_count = shape->triangles;
  s->mesh.indices = shape->indices;
  s->mesh.positions = (float *)malloc(3 * shape->vertices * sizeof(float));
  if (shape->failed || !s->mesh.positions) fail("no memory");
  s->radius = 0;
  for (size_t i = 0; i < 3 * shape->vertices; i++) {
    s->mesh.positions[i] = (float)shape->positions[i];
    shape->positions[i] = (double)s->mesh.positions[i];
  }
  for (size_t v = 0; v < shape->vertices; v++) s->radius = fmax(s->radius, oracle_length(shape->positions + 3 * v));
  if (!oracle_mesh_init(&s->oracle, shape->positions, shape->vertices, shape->indices, shape->triangles, 1)) {
    fail("no memory");
  }
}

static void make_bodies(solid *bodies) {
  for (int k = 0; k < BODIES; k++) {
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    if (k == 0) shapes_mug(&shape, 0.1, 0.2, 0.01, 48);
    if (k == 1) shapes_box(&shape, 0.3, 0.2, 0.1, 6);
    if (k == 2) level_boulder(&shape, 0.15, 16, 1);
    if (k == 3) shapes_drawer(&shape, 0.3, 0.2, 0.1, 0.01);
    if (k == 4) level_arch(&shape, 0.12, 0.03, 24);
    if (k == 5) shapes_plate(&shape, 0.15, 0.03, 0.01, 48);
    solid_init(&bodies[k], &shape, 0.3);
    if (nsvcd_encode(&bodies[k].mesh, NULL, NULL, NULL, 0, &bodies[k].body)) fail("a body was refused");
  }
}

// ---- motions

static nsvcd_pose pose_of(const oracle_pose *from) {
  nsvcd_pose to;
  for (int k = 0; k < 3; k++) to.position[k] = (float)from->position[k];
  for (int k = 0; k < 4; k++) to.rotation[k] = (float)from->rotation[k];
  return to;
}
static oracle_pose as_stored(const nsvcd_pose *from) {
  oracle_pose to;
  for (int k = 0; k < 3; k++) to.position[k] = (double)from->position[k];
  for (int k = 0; k < 4; k++) to.rotation[k] = (double)from->rotation[k];
  oracle_quat_normalize(to.rotation);
  return to;
}

// The least distance of a motion from the level, stopping early.
static double gap_of(const solid *body, const solid *level, const oracle_pose *poses) {
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  oracle_options options = {1e-5, 0.1, 0, 1};
  return oracle_sweep(&body->oracle, poses, 2, &level->oracle, &origin, &options).distance;
}

// Two poses about a place above the level's surface. Returns 0 if the draw is of no use.
static int draw_motion(shapes_rng *rng, int set, const solid *body, const solid *level, oracle_pose *poses) {
  const oracle_triangle *t = &level->oracle.triangles[shapes_next(rng) % level->oracle.triangle_count];
  const double way = set == NEAR ? 0.1 : set == SLIDE ? 0.05 : 1;
  const double turn = shapes_uniform(rng, 0, set == SLIDE ? 0 : set == NEAR ? 0.15 : 1);
  double axis[3], direction[3], spin[4], u = shapes_uniform(rng, 0, 1), v = shapes_uniform(rng, 0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  shapes_quaternion(rng, poses[0].rotation);
  shapes_direction(rng, axis);
  shapes_direction(rng, direction);
  oracle_axis_angle(axis, turn, spin);
  oracle_quat_mul(spin, poses[0].rotation, poses[1].rotation);
  const double length = shapes_uniform(rng, 0, way);
  double up[3] = {0, 0, 1};
  if (set == SLIDE) direction[2] = 0;
  const double out = body->radius + shapes_uniform(rng, -0.1, 0.1);
  for (int k = 0; k < 3; k++) {
    const double place = t->v[0][k] + u * (t->v[1][k] - t->v[0][k]) + v * (t->v[2][k] - t->v[0][k]);
    poses[0].position[k] = place + out * t->normal[k];
    poses[1].position[k] = poses[0].position[k] + length * direction[k];
  }
  if (!(poses[0].position[2] > -0.5)) return 0;  // below the ground, or by a triangle without a normal
  if (set != SLIDE) return 1;
  // Let down until it slides at the gap that is wanted, by the oracle.
  const double wanted = 1e-4 * pow(10, shapes_uniform(rng, 0.3, 2));
  for (int step = 0; step < 60; step++) {
    const double gap = gap_of(body, level, poses);
    if (gap <= 0) return 0;
    if (fabs(gap - wanted) < 0.1 * wanted) return 1;
    for (int n = 0; n < 2; n++) {
      for (int k = 0; k < 3; k++) poses[n].position[k] += (wanted - gap) * up[k];
    }
  }
  return 0;
}

// The piece of the level that a motion can reach.
static const nsvcd_body *local_piece(const solid *level, const solid *body, const nsvcd_pose *poses) {
  float low[3], high[3];
  nsvcd_mesh part;
  const nsvcd_body *piece;
  nsvcd_encode_options open;
  memset(&open, 0, sizeof open);
  open.open = 1;
  for (int k = 0; k < 3; k++) {
    const float reach = (float)(body->radius + REACH);
    low[k] = fminf(poses[0].position[k], poses[1].position[k]) - reach;
    high[k] = fmaxf(poses[0].position[k], poses[1].position[k]) + reach;
  }
  const nsvcd_result cut = nsvcd_mesh_cut(&level->mesh, low, high, NULL, &part);
  if (cut == NSVCD_ERROR_EMPTY) return NULL;
  if (cut || nsvcd_encode(&part, &open, NULL, NULL, 0, &piece)) fail("a piece was refused");
  nsvcd_mesh_free(&part, NULL);
  return piece;
}

// ---- the comparison

static int compare_doubles(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double microseconds(const nsvcd_question *question, void *workspace, size_t size, nsvcd_answer *answer) {
  double best = 1e9;
  for (int run = 0; run < RUNS; run++) {
    const double start = seconds();
    if (nsvcd_sweep(question, workspace, size, answer)) fail("a question was refused");
    best = fmin(best, 1e6 * (seconds() - start));
  }
  return best;
}

static double print_times(const char *name, double *times, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; i++) sum += times[i];
  qsort(times, count, sizeof *times, compare_doubles);
  printf("    %-6s median %6.1f  mean %6.1f  99 %% %7.1f us\n", name, times[count / 2], sum / (double)count,
         times[count * 99 / 100]);
  return sum / (double)count;
}

// One set of motions. Returns how many verdicts are wrong.
static size_t run_set(int set, size_t motions, const solid *bodies, const solid *level, void *workspace, size_t size) {
  shapes_rng rng = {(uint64_t)(100 + set)};
  double *times[2];
  size_t hits = 0, free_of = 0, wrong = 0, undecided = 0, differ = 0, close_calls = 0, count = 0;
  for (int k = 0; k < 2; k++) times[k] = (double *)malloc((motions + 1) * sizeof(double));
  if (!times[0] || !times[1]) fail("no memory");
  while (count < motions) {
    const solid *body = &bodies[shapes_pick(&rng, BODIES)];
    oracle_pose poses[2];
    if (!draw_motion(&rng, set, body, level, poses)) continue;
    const nsvcd_pose stored[2] = {pose_of(&poses[0]), pose_of(&poses[1])};
    for (int n = 0; n < 2; n++) poses[n] = as_stored(&stored[n]);
    const nsvcd_body *piece = local_piece(level, body, stored);
    if (!piece) continue;
    const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
    const oracle_options options = {2e-5, 1e-3, 0, 0};
    const oracle_result label = oracle_sweep(&body->oracle, poses, 2, &level->oracle, &origin, &options);
    nsvcd_question question;
    nsvcd_answer whole, local;
    memset(&question, 0, sizeof question);
    question.a.body = body->body;
    question.a.poses = stored;
    question.a.count = 2;
    question.b.body = level->body;
    times[0][count] = microseconds(&question, workspace, size, &whole);
    question.b.body = piece;
    times[1][count] = microseconds(&question, workspace, size, &local);
    nsvcd_body_free(piece, NULL);
    count++;

    undecided += whole.status == NSVCD_STATUS_UNDECIDED;
    differ += whole.collides != local.collides && label.status != ORACLE_INSIDE;
    if (label.status == ORACLE_FREE && label.distance < MARGIN) {
      close_calls++;
      continue;
    }
    const int collides = label.status == ORACLE_COLLIDES || label.status == ORACLE_INSIDE;
    hits += collides != 0;
    free_of += !collides;
    if (whole.status != NSVCD_STATUS_UNDECIDED) wrong += whole.collides != collides;
  }
  printf("  %s: %zu hits, %zu free, %zu within %g mm of contact; %zu wrong, %zu undecided, %zu unlike the piece\n",
         set_names[set], hits, free_of, close_calls, 1e3 * MARGIN, wrong, undecided, differ);
  const double whole = print_times("level", times[0], count);
  const double local = print_times("piece", times[1], count);
  printf("    x %.2f\n", whole / local);
  free(times[0]);
  free(times[1]);
  return wrong;
}

int main(int argc, char **argv) {
  const size_t triangles = argc > 1 ? strtoul(argv[1], NULL, 10) : 200000;
  const size_t motions = argc > 2 ? strtoul(argv[2], NULL, 10) : 200;
  solid level, bodies[BODIES];
  shapes_mesh shape;
  nsvcd_encode_options options;
  memset(&level, 0, sizeof level);
  memset(bodies, 0, sizeof bodies);
  memset(&shape, 0, sizeof shape);
  memset(&options, 0, sizeof options);
  options.no_latents = 1;
  if (argc > 3) options.points = strtoul(argv[3], NULL, 10);
  setvbuf(stdout, NULL, _IOLBF, 0);
  make_bodies(bodies);
  level_make(&shape, SIDE, triangles, 1);
  solid_init(&level, &shape, 0);

  heap h = {0, 0};
  nsvcd_allocator allocator = {heap_alloc, heap_free, &h};
  const double start = seconds();
  if (nsvcd_encode(&level.mesh, &options, &allocator, NULL, 0, &level.body)) fail("the level was refused");
  const double took = seconds() - start;
  const nsvcd_body_facts facts = nsvcd_body_describe(level.body);
  const double per = 1 / (double)level.mesh.triangle_count;
  printf("%zu triangles, N = %zu: encoded in %.0f ms, at most %.0f bytes a triangle at a time; body %.1f MB, %.1f bytes a "
         "triangle; quantum %.1f um\n",
         level.mesh.triangle_count, facts.points, 1e3 * took, per * (double)h.most, 1e-6 * (double)facts.size,
         per * (double)facts.size, 1e6 * (double)facts.quantum);

  const size_t size = nsvcd_sweep_workspace_size();
  void *workspace = malloc(size);
  size_t wrong = 0;
  for (int set = 0; set < SETS; set++) wrong += run_set(set, motions, bodies, &level, workspace, size);
  return wrong > 0;
}
