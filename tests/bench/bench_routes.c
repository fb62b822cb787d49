// bench_routes.c - an arm among shelves, in a box, on and under a table, in a cage: how many ways are
// found, in what time, and is any of them wrong?
//
//   build/bench_routes [PROBLEMS] [LOOKS] [SEED] [KIND]
//   build/route_peers [PROBLEMS] [LOOKS] [SEED] [KIND]    also with other checks than proofs
//
// PROBLEMS of each kind (100), each motion looked at LOOKS times (2001) by distances in double, with
// links placed by matrices. KIND: one of 0 to 6.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#ifdef ROUTE_PEERS  // a header whose planner calls this, see route_peers.h
#include "peers/neuralsvcd_robot.h"
static nsvcd_result peer_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                               const nsvcd_check_options *options, nsvcd_check_answer *answer);
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "peers/neuralsvcd_robot.h"
#else
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../../extras/neuralsvcd_robot.h"
#endif
#include "arm_scene.h"
#include "meter.h"
#ifdef ROUTE_PEERS
#include "route_peers.h"
#endif

#define MOST_PROBLEMS 1000

static double median_of(double *x, size_t count) {
  meter_sort(x, count);
  return count ? x[count / 2] : 0;
}
static double mean_of(const double *x, size_t count) {
  double sum = 0;
  for (size_t n = 0; n < count; n++) sum += x[n];
  return count ? sum / (double)count : 0;
}

typedef struct tally {
  size_t problems, found, wrong, rough, stopping, checks, proven, nodes;
  double times[3][MOST_PROBLEMS];  // ms: the trees; with shortcuts; all
  double ratios[MOST_PROBLEMS];    // duration, of that without obstacles
} tally;

// How near the motion comes, and is it smooth and within the limits? Speeds by differences of places.
static double least_apart(const arm_scene *s, const nsvcd_joint_motion *m, size_t looks,
                          int *is_rough) {
  double least = 0.1;
  double last[2][ARM_JOINTS];
  const double end = m->times[m->pieces];
  const double step = end / (double)(looks - 1);
  size_t piece = 0;
  for (size_t k = 0; k < looks; k++) {
    double q[ARM_JOINTS];
    const double t = fmin(end, step * (double)k);
    while (piece + 1 < m->pieces && m->times[piece + 1] <= t) piece++;
    const double fraction = (t - m->times[piece]) / (m->times[piece + 1] - m->times[piece]);
    joints_of_piece(m->points + 2 * piece * ARM_JOINTS, 2, ARM_JOINTS, fraction, q);
    least = fmin(least, arm_apart(s, q, least));
    for (size_t j = 0; j < ARM_JOINTS; j++) {
      const nsvcd_joint *joint = &s->joints[j];
      const double speed = k > 0 ? (q[j] - last[0][j]) / step : 0;
      const double before = k > 1 ? (last[0][j] - last[1][j]) / step : 0;
      if (fabs(speed) > joint->speed * (1 + 1e-9)) *is_rough = 1;
      // with a step of 1 ms a jump of speed of 0.01 would show
      if (k > 1 && fabs(speed - before) > joint->acceleration * step * (1 + 1e-6) + 1e-9)
        *is_rough = 1;
      if (q[j] < joint->low - 1e-9 || q[j] > joint->high + 1e-9) *is_rough = 1;
      last[1][j] = last[0][j];
      last[0][j] = q[j];
    }
  }
  return least;
}

static void run_problem(arm_scene *s, arm_kind kind, shapes_rng *rng, size_t looks, tally *t) {
  double start[ARM_JOINTS], goal[ARM_JOINTS];
  nsvcd_route_answer answer;
  const double room = 0.001 * pow(20, shapes_uniform(rng, 0, 1));
  if (!arm_configuration(s, rng, kind, 0, room, start)) return;
  if (!arm_configuration(s, rng, kind, 1, room, goal)) return;
  const size_t size = nsvcd_checker_size(&s->scene);
  t->problems++;
  memset(&answer, 0, sizeof answer);
  for (int part = 0; part < 3; part++) {
    nsvcd_route_problem problem;
    nsvcd_route_options options;
    memset(&problem, 0, sizeof problem);
    memset(&options, 0, sizeof options);
    options.nodes = 100000;
#ifdef ROUTE_PEERS
    options.looks = NSVCD_NONE;  // it is edges that are compared
#endif
    options.shortcuts = part > 0 ? 0 : NSVCD_NONE;
    options.smoothings = part > 1 ? 0 : NSVCD_NONE;
    problem.start = start;
    problem.goals = goal;
    problem.goal_count = 1;
    nsvcd_checker_open(&s->scene, s->memory, size, &s->checker);
    const size_t route_size = nsvcd_route_size(s->checker, &problem, &options);
    void *memory = malloc(route_size);
    if (!memory) exit(1);
    const double began = seconds();
    if (nsvcd_route(s->checker, &problem, &options, memory, route_size, &answer)) exit(1);
    t->times[part][t->found] = 1e3 * (seconds() - began);
    if (part == 2 && answer.status == NSVCD_ROUTE_FOUND) {
      int is_rough = 0;
      const double apart = looks ? least_apart(s, &answer.motion, looks, &is_rough) : 1;
      if (!(apart > 0)) {
        t->wrong++;
        printf("WRONG: apart %g\n", apart);
      }
      t->rough += (size_t)is_rough;
      t->stopping += answer.stops > 0;
      t->ratios[t->found] = answer.duration / answer.unhindered;
      t->checks += answer.checks;
      t->proven += answer.proven;
      t->nodes += answer.nodes;
      t->found++;
    }
    free(memory);
  }
  if (answer.status != NSVCD_ROUTE_FOUND)
    printf("not found: %s, why %d, %zu nodes, %zu checks, %zu proven\n",
           nsvcd_route_status_string(answer.status), (int)answer.check.why, answer.nodes,
           answer.checks, answer.proven);
}

static int run_kind(arm_kind kind, size_t problems, size_t looks, uint64_t seed, const char *by) {
  static arm_scene s;
  static tally tallies[ARM_KINDS];
  shapes_rng rng = {seed * 1000 + (uint64_t)kind};
  tally *t = &tallies[kind];
  memset(t, 0, sizeof *t);
  arm_make(&s);
  arm_furnish(&s, kind);
  arm_open(&s);
#ifdef ROUTE_PEERS
  peer_prepare(&s, peer_now);
#endif
  for (size_t n = 0; n < 20 * problems && t->problems < problems; n++)
    run_problem(&s, kind, &rng, looks, t);
  const double found = fmax((double)t->found, 1);
  double means[3];
  for (int part = 0; part < 3; part++) means[part] = mean_of(t->times[part], t->found);
  printf(
      "| %s%s | %zu | %zu | %zu | %zu | %zu | %.1f / %.1f | %.1f / %.1f | %.1f / %.1f | %.2f | "
      "%.0f, %.0f | %.0f |\n",
      arm_kinds[kind], by, t->problems, t->found, t->wrong, t->stopping, t->rough,
      median_of(t->times[0], t->found), means[0], median_of(t->times[1], t->found), means[1],
      median_of(t->times[2], t->found), means[2], median_of(t->ratios, t->found),
      (double)t->checks / found, (double)t->proven / found, (double)t->nodes / found);
  fflush(stdout);
#ifdef ROUTE_PEERS
  peer_release(&s);
#endif
  arm_close(&s);
  return t->wrong > 0;
}

int main(int count, char **values) {
  const size_t problems = count > 1 ? (size_t)atoi(values[1]) : 100;
  const size_t looks = count > 2 ? (size_t)atoi(values[2]) : 2001;
  const uint64_t seed = count > 3 ? (uint64_t)atoi(values[3]) : 1;
  const int only = count > 4 ? atoi(values[4]) : -1;
  int wrong = 0;
  if (problems > MOST_PROBLEMS) return 2;
  printf(
      "| | problems | found | wrong | with stops | rough | ms: trees, median / mean | + shortcuts "
      "| all | duration, of that without obstacles: median | checks, free | nodes "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int kind = 0; kind < ARM_KINDS; kind++) {
    if (only >= 0 && kind != only) continue;
#ifdef ROUTE_PEERS
    for (size_t n = 0; n < ROUTE_PEERS_COUNT; n++) {
      char by[80];
      peer_now = &route_peers[n];
      snprintf(by, sizeof by, ": %s", peer_now->name);
      const int is_wrong = run_kind((arm_kind)kind, problems, looks, seed, by);
      if (n == 0) wrong |= is_wrong;
    }
#else
    wrong |= run_kind((arm_kind)kind, problems, looks, seed, "");
#endif
  }
  return wrong;
}
