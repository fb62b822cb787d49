// bench_stops.c - how soon do the calls of neuralsvcd_robot.h return once `stop` says so? The longest
// time between two calls of it, from the function's own beginning to its end, in CPU time: the time
// from a `stop` that just missed it. A gripper of 100,000 triangles among shelves and in cages, and
// two rings of 200,000 triangles each, one through the other, that nearly touch.
//
//   build/bench_stops [PROBLEMS] [SEED]
#define _POSIX_C_SOURCE 200112L
#include <time.h>
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../../extras/neuralsvcd_robot.h"
#include "arm_scene.h"
#include "meter.h"

// CPU seconds: another load does not count.
static double cpu_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct gaps {
  double last, longest, end;  // seconds; `end`: when it begins to say stop, HUGE_VAL: never
  double late;                // the longest from then to the return
  size_t calls;
} gaps;

static int note_gap(void *user) {
  gaps *g = (gaps *)user;
  const double now = cpu_seconds();
  g->longest = fmax(g->longest, now - g->last);
  g->last = now;
  g->calls++;
  return now >= g->end;
}

// Between this and gaps_end the function is called.
static void gaps_begin(gaps *g, double most) {
  g->last = cpu_seconds();
  g->end = g->last + most;
}
static void gaps_end(gaps *g) {
  const double now = cpu_seconds();
  g->longest = fmax(g->longest, now - g->last);
  if (now > g->end) g->late = fmax(g->late, now - g->end);
}

static void tell(const char *what, const gaps *g) {
  printf("| %s | %zu | %.2f | %.2f |\n", what, g->calls, 1e3 * g->longest, 1e3 * g->late);
  fflush(stdout);
}

// ---- routes

static void ask_routes(arm_kind kind, size_t problems, uint64_t seed) {
  static arm_scene s;
  shapes_rng rng = {seed};
  char name[64];
  gaps by_looks = {0, 0, 0, 0, 0};
  gaps by_proofs = {0, 0, 0, 0, 0};
  arm_make(&s);
  arm_furnish(&s, kind);
  arm_open(&s);
  for (size_t n = 0; n < problems; n++) {
    double start[ARM_JOINTS], goal[ARM_JOINTS];
    if (!arm_configuration(&s, &rng, kind, 0, 0.002, start)) continue;
    if (!arm_configuration(&s, &rng, kind, 1, 0.002, goal)) continue;
    for (int k = 0; k < 4; k++) {
      gaps *g = k % 2 ? &by_proofs : &by_looks;
      nsvcd_route_problem problem;
      nsvcd_route_options options;
      nsvcd_route_answer answer;
      memset(&problem, 0, sizeof problem);
      memset(&options, 0, sizeof options);
      options.looks = k % 2 ? NSVCD_NONE : 0;
      problem.start = start;
      problem.goals = goal;
      problem.goal_count = 1;
      problem.stop = problem.abandon = note_gap;
      problem.user = g;
      const size_t size = nsvcd_route_size(s.checker, &problem, &options);
      void *memory = malloc(size);
      if (!memory) exit(1);
      gaps_begin(g, k < 2 ? 2 : shapes_uniform(&rng, 0, 0.02));
      if (nsvcd_route(s.checker, &problem, &options, memory, size, &answer)) exit(1);
      gaps_end(g);
      free(memory);
    }
  }
  snprintf(name, sizeof name, "route, %s: by looks", arm_kinds[kind]);
  tell(name, &by_looks);
  snprintf(name, sizeof name, "route, %s: by proofs", arm_kinds[kind]);
  tell(name, &by_proofs);
  arm_close(&s);
}

// ---- rings

// A ring in a hollow ring, with 0.2 mm of room all around: two slides and three turns move it.
static void rings_make(arm_scene *s) {
  static const int axes[5] = {0, 2, 0, 1, 2};
  shapes_mesh mesh;
  memset(s, 0, sizeof *s);
  memset(&mesh, 0, sizeof mesh);
  s->scene.joints = s->joints;
  s->scene.parts = s->parts;
  s->scene.pairs = s->pairs;
  s->scene.joint_count = 5;
  for (uint32_t j = 0; j < 5; j++) {
    s->joints[j].kind = j < 2 ? NSVCD_JOINT_PRISMATIC : NSVCD_JOINT_REVOLUTE;
    s->joints[j].parent = j;
    s->joints[j].origin.rotation[3] = 1;
    s->joints[j].axis[axes[j]] = 1;
    s->joints[j].low = j < 4 ? -0.01 : -3;
    s->joints[j].high = -s->joints[j].low;
  }
  shapes_torus(&mesh, 0.12, 0.0302, 400, 250);
  for (size_t n = 0; n < mesh.triangles; n++) {  // its inner wall faces inwards
    const uint32_t was = mesh.indices[3 * n];
    mesh.indices[3 * n] = mesh.indices[3 * n + 1];
    mesh.indices[3 * n + 1] = was;
  }
  shapes_torus(&mesh, 0.12, 0.035, 400, 250);
  arm_add(s, &mesh, 0, 0, 0, 0);
  shapes_torus(&mesh, 0.12, 0.03, 400, 250);
  arm_add(s, &mesh, 5, 0, 0, 0);
  s->pairs[0].a = 1;
  s->scene.pair_count = 1;
  const size_t size = nsvcd_checker_size(&s->scene);
  s->memory = calloc(1, size);
  if (!size || nsvcd_checker_open(&s->scene, s->memory, size, &s->checker)) exit(1);
}

static void ask_rings(size_t problems, uint64_t seed) {
  static arm_scene s;
  shapes_rng rng = {seed};
  gaps checks = {0, 0, 0, 0, 0};
  gaps reaches = {0, 0, 0, 0, 0};
  gaps ranges = {0, 0, 0, 0, 0};
  gaps nearest = {0, 0, 0, 0, 0};
  rings_make(&s);
  for (size_t n = 0; n < 4 * problems; n++) {
    double points[3 * 5];
    const nsvcd_joint_motion motion = {1, 2, points, NULL};
    nsvcd_check_answer found;
    nsvcd_check_options options;
    const double clearance = 2e-4 * pow(10, -shapes_uniform(&rng, 0, 2));
    memset(&options, 0, sizeof options);
    for (size_t i = 0; i < 15; i++)
      points[i] = shapes_uniform(&rng, -1, 1) * (i % 5 < 4 ? 1e-4 : 2);
    options.clearance = n % 4 ? (float)clearance : 0;
    options.stop = note_gap;
    options.user = &checks;
    options.to_time = n % 2 ? 1e-4 : 0;
    if (n % 5 == 0) options.work = 10000000;
    gaps_begin(&checks, n % 3 ? HUGE_VAL : shapes_uniform(&rng, 0, 0.05));
    if (nsvcd_check(s.checker, &motion, &options, &found)) exit(1);
    gaps_end(&checks);
    nsvcd_nearest_free_options near;
    int is_found;
    double out[5];
    memset(&near, 0, sizeof near);
    near.stop = note_gap;
    near.user = &nearest;
    near.clearance = options.clearance;
    gaps_begin(&nearest, n % 3 ? 1 : shapes_uniform(&rng, 0, 0.05));
    if (nsvcd_nearest_free(s.checker, points, &near, out, &is_found)) exit(1);
    gaps_end(&nearest);
  }
  tell("check, rings", &checks);
  tell("nearest_free, rings", &nearest);
  for (size_t n = 0; n < problems; n++) {
    nsvcd_reach_problem problem;
    nsvcd_reach_options options;
    nsvcd_reach_answer answer;
    double start[5], out[16 * 5];
    memset(&problem, 0, sizeof problem);
    memset(&options, 0, sizeof options);
    memset(start, 0, sizeof start);
    problem.start = start;
    problem.link = 5;
    problem.tool.rotation[3] = problem.target.rotation[3] = 1;
    problem.target.position[0] = (float)shapes_uniform(&rng, -1e-4, 1e-4);
    problem.free_axis[2] = 1;
    problem.stop = note_gap;
    problem.user = &reaches;
    options.seed = n;
    options.clearance = 1e-5f;
    gaps_begin(&reaches, n % 3 ? 2 : shapes_uniform(&rng, 0, 0.05));
    if (nsvcd_reach(s.checker, &problem, &options, out, 16, &answer)) exit(1);
    gaps_end(&reaches);
  }
  tell("reach, rings", &reaches);
  for (size_t n = 0; n < problems; n++) {
    const nsvcd_body_pair pair = {0, 1};
    nsvcd_range_options options;
    nsvcd_range_answer answer;
    memset(&options, 0, sizeof options);
    options.clearance = n % 2 ? 1e-4f : 1e-6f;
    options.stop = note_gap;
    options.user = &ranges;
    options.seed = n;
    const size_t size = nsvcd_pair_range_size(s.checker, pair, &options);
    void *memory = malloc(size);
    if (!memory) exit(1);
    gaps_begin(&ranges, n % 3 ? 2 : shapes_uniform(&rng, 0, 0.05));
    if (nsvcd_pair_range(s.checker, pair, &options, memory, size, &answer)) exit(1);
    gaps_end(&ranges);
    free(memory);
  }
  tell("pair_range, rings", &ranges);
  arm_close(&s);
}

int main(int count, char **values) {
  const size_t problems = count > 1 ? (size_t)atoi(values[1]) : 20;
  const uint64_t seed = count > 2 ? (uint64_t)atoi(values[2]) : 1;
  printf("| | calls of stop | ms between two, at most | ms from stop to return, at most |\n");
  printf("|---|---|---|---|\n");
  for (int kind = 0; kind < ARM_KINDS && !getenv("RINGS"); kind++)
    ask_routes((arm_kind)kind, problems, seed);
  ask_rings(problems, seed);
  return 0;
}
