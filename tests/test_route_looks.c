// Routes that go by looks: are links where the joints say, is what is handed out free, whatever looks
// say, and does each pair keep its clearance? Against distances in double; looks lie here on purpose.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"

// What looks say: the truth; that all is free; that all meets; the opposite, now and then.
typedef enum lie { LIE_NOT, LIE_FREE, LIE_MEETS, LIE_RARELY, LIE_OFTEN, LIE_FAILS, LIES } lie;
static lie lie_now;
static uint64_t lie_count;
static nsvcd_result lying_look(const nsvcd_looked *a, const nsvcd_looked *b,
                               const nsvcd_look_options *options, uint32_t *met) {
  const nsvcd_result result = nsvcd_look(a, b, options, met);
  const uint64_t drawn = (++lie_count * 0x9e3779b97f4a7c15u) >> 32;
  if (lie_now == LIE_FREE) *met = 0;
  if (lie_now == LIE_MEETS) *met = 1;
  if (lie_now == LIE_RARELY && drawn % 64 == 0) *met = !*met;
  if (lie_now == LIE_OFTEN && drawn % 4 == 0) *met = !*met;
  return lie_now == LIE_FAILS ? NSVCD_ERROR_BODY : result;
}
#define nsvcd_look lying_look
#include "../extras/neuralsvcd_robot.h"
#undef nsvcd_look

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "check.h"
#define ROBOT_BALLS 64
#include "route_scene.h"

void test_route_looks(void);

// The places of all parts that move, against forward kinematics.
static void looks_have_parts_where_joints_say(void) {
  static robot r;
  shapes_rng rng = {21};
  double worst = 0;
  for (int trial = 0; trial < 200; trial++) {
    robot_random(&r, &rng);
    r.scene.pair_count = 0;
    robot_open(&r);
    uint64_t used = 0;
    nsvcd__looker looker;
    memset(&looker, 0, sizeof looker);
    nsvcd__looker_take(&r.scene, NULL, &used, &looker);
    char *memory = (char *)calloc(1, (size_t)used + 1);
    if (!memory) exit(1);
    used = 0;
    nsvcd__looker_take(&r.scene, memory, &used, &looker);
    nsvcd__looker_begin(r.checker, NULL, &looker);
    double places[NSVCD_MAX_JOINTS][NSVCD_LOOKS];
    const double turns = trial % 4 ? 3 : 1000;
    for (size_t j = 0; j < r.scene.joint_count; j++)
      for (size_t l = 0; l < NSVCD_LOOKS; l++) places[j][l] = shapes_uniform(&rng, -turns, turns);
    nsvcd__look_place_links(&looker, places);
    for (size_t n = 0; n < r.scene.part_count; n++) {
      const nsvcd_looked seen = nsvcd__look_at_part(&looker, n);
      for (size_t l = 0; l < NSVCD_LOOKS; l++) {
        double q[NSVCD_MAX_JOINTS];
        for (size_t j = 0; j < r.scene.joint_count; j++) q[j] = places[j][l];
        const placed at = placed_part(&r.scene, n, q);
        const double size = 1 + turns * (double)r.scene.joint_count;
        for (int k = 0; k < 9; k++)
          worst = fmax(worst, fabs((double)seen.places->rotation[k][l] - at.m[k]));
        for (int k = 0; k < 3; k++) {
          worst = fmax(worst, fabs((double)seen.places->position[k][l] - at.p[k]) / size);
          // a part is in its box
          double centre[3];
          const robot_shape *shape = &robot_shapes()[r.shape[n]];
          placed_point(&at, scale_of_part(&r.parts[n]), shape->exact.center, centre);
          CHECK_GE(centre[k] + 1e-5 * size, (double)looker.parts[n].low[k]);
          CHECK_LE(centre[k] - 1e-5 * size, (double)looker.parts[n].high[k]);
        }
      }
    }
    free(memory);
    free(r.memory);
  }
  CHECK_LE(worst, 5e-6);
}

// Is a route free at 301 times, with all clearances, smooth, and from the start to the goal?
static void route_is_right(const robot *r, const asked_route *a) {
  const nsvcd_joint_motion *m = &a->answer.motion;
  robot_motion_is_smooth(r, m, a->start, a->goals[0]);
  for (int k = 0; k <= 300; k++) {
    double q[6];
    joints_at_time(m, 6, m->times[m->pieces] * k / 300, q);
    for (size_t p = 0; p < r->scene.pair_count; p++) {
      const double own = r->scene.clearances ? (double)r->scene.clearances[p] : 0;
      const double kept = (double)a->options.clearance + own;
      CHECK_LE(kept, robot_apart(r, &r->pairs[p], q, 0.1) + 1e-9);
    }
  }
}

// An arm among shapes, with a start and a goal that are free. Every third pair keeps 5 mm.
static int route_asked(robot *r, shapes_rng *rng, int trial, asked_route *a) {
  static float clearances[MOST_PARTS * MOST_PARTS];
  memset(a, 0, sizeof *a);
  a->options.clearance = trial % 3 ? 0 : 0.01f;
  a->options.seed = (uint64_t)trial;
  robot_arm(r, rng, 14);
  for (size_t j = 0; j < 6; j++) {
    r->joints[j].speed = shapes_uniform(rng, 1, 3);
    r->joints[j].acceleration = shapes_uniform(rng, 3, 10);
  }
  for (size_t p = 0; p < r->scene.pair_count; p++) clearances[p] = p % 3 ? 0 : 0.005f;
  r->scene.clearances = trial % 2 ? clearances : NULL;
  return robot_free_place(r, rng, a->options.clearance, a->start) &&
         robot_free_place(r, rng, a->options.clearance, a->goals[0]);
}

// By looks, true ones and others: what is found is right, and from the same seed it is the same.
static void routes_are_right_whatever_looks_say(void) {
  static robot r;
  shapes_rng rng = {31};
  size_t asked = 0;
  size_t found = 0;
  size_t by_looks = 0;
  size_t refuted = 0;
  for (int trial = 0; trial < 36; trial++) {
    asked_route a;
    lie_now = (lie)(trial % LIES);
    lie_count = 0;
    if (route_asked(&r, &rng, trial, &a)) {
      asked++;
      // false looks find nothing for long
      a.options.looks = lie_now == LIE_NOT ? 0 : 3000;
      ask_route(&r, &a);
      CHECK(a.answer.looks > 0);
      found += a.answer.status == NSVCD_ROUTE_FOUND;
      by_looks += lie_now == LIE_NOT && a.answer.nodes > 3 && a.answer.looks < 2000;
      refuted += a.answer.checks > 8 && a.answer.looks < (lie_now ? 3000 : 2000);
      if (a.answer.status == NSVCD_ROUTE_FOUND) route_is_right(&r, &a);
    }
    if (a.answer.status == NSVCD_ROUTE_FOUND && trial % LIES == 0) {
      asked_route again = a;
      again.memory = NULL;
      const size_t size = nsvcd_checker_size(&r.scene);
      CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &r.checker), NSVCD_OK);
      ask_route(&r, &again);
      const size_t count = (2 * a.answer.motion.pieces + 1) * 6;
      CHECK_EQ(again.answer.motion.pieces, a.answer.motion.pieces);
      CHECK_EQ(memcmp(again.answer.motion.points, a.answer.motion.points, count * sizeof(double)),
               0);
      CHECK_EQ(again.answer.looks, a.answer.looks);
      // none is looked at where none is wanted
      again.options.looks = NSVCD_NONE;
      ask_route(&r, &again);
      CHECK_EQ(again.answer.looks, 0);
      free(again.memory);
    }
    free(a.memory);
    free(r.memory);
  }
  lie_now = LIE_NOT;
  printf("  %zu of %zu found, %zu by looks, %zu after one was refuted\n", found, asked, by_looks,
         refuted);
  CHECK_GE(asked, 30);
  CHECK_GE(found + 3, asked);
  CHECK_GE(by_looks, 2);
  CHECK_GE(refuted, 2);
}

// The caller ends a search in the midst of looks, by either function, at once.
static void looks_end_when_told(void) {
  static robot r;
  shapes_rng rng = {41};
  size_t stopped = 0;
  lie_now = LIE_MEETS;  // so that it looks for long
  for (int trial = 0; trial < 6; trial++) {
    asked_route a;
    if (route_asked(&r, &rng, 3 * trial + 1, &a)) {
      int left = 40;
      a.problem.user = &left;
      *(trial % 2 ? &a.problem.stop : &a.problem.abandon) = robot_stop;
      if (trial % 2 == 0) left = 2000;  // the ends are proven first
      ask_route(&r, &a);
      stopped += a.answer.status == NSVCD_ROUTE_STOPPED;
      CHECK(a.answer.status == NSVCD_ROUTE_STOPPED || a.answer.status == NSVCD_ROUTE_FOUND);
      CHECK_GE(left, -8);
      CHECK_LE(a.answer.looks, trial % 2 ? 40 : 2000);
    }
    free(a.memory);
    free(r.memory);
  }
  lie_now = LIE_NOT;
  CHECK_GE(stopped, 3);
}

// Each pair keeps its own clearance, beside the one asked for.
static void pairs_keep_their_clearances(void) {
  static robot r;
  shapes_rng rng = {51};
  static float clearances[MOST_PARTS * MOST_PARTS];
  size_t hits = 0;
  size_t freed = 0;
  robot_arm(&r, &rng, 14);
  const size_t size = nsvcd_checker_size(&r.scene);
  r.scene.clearances = clearances;
  for (int trial = 0; trial < 400; trial++) {
    double q[6];
    const nsvcd_joint_motion still = {0, 0, q, NULL};
    nsvcd_check_options options;
    nsvcd_check_answer answer;
    memset(&options, 0, sizeof options);
    options.clearance = trial % 2 ? 0 : 0.01f;
    for (int j = 0; j < 6; j++) q[j] = shapes_uniform(&rng, -3.1, 3.1);
    int is_near = 0;
    int is_plain = 0;
    for (size_t p = 0; p < r.scene.pair_count; p++) {
      clearances[p] = shapes_pick(&rng, 2) ? 0 : (float)shapes_uniform(&rng, 0, 0.1);
      const double apart = robot_apart(&r, &r.pairs[p], q, 0.2);
      const double kept = (double)options.clearance + (double)clearances[p];
      is_near |= apart <= 0 || apart < kept - 1e-6;
      is_plain |= apart <= 0 || apart < (double)options.clearance - 1e-6;
    }
    CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &r.checker), NSVCD_OK);
    CHECK_EQ(nsvcd_check(r.checker, &still, &options, &answer), NSVCD_OK);
    CHECK_EQ(answer.verdict, is_near ? NSVCD_HIT : NSVCD_FREE);
    hits += is_near && !is_plain;
    freed += !is_near;
  }
  CHECK_GE(hits, 20);
  CHECK_GE(freed, 20);
  const float bad[3] = {-1e-3f, NAN, 2e6f};
  for (int k = 0; k < 3; k++) {
    clearances[3] = bad[k];
    CHECK_EQ(nsvcd_checker_open(&r.scene, r.memory, size, &r.checker), NSVCD_ERROR_CLEARANCE);
    CHECK_EQ(nsvcd_checker_size(&r.scene), 0);
  }
  free(r.memory);
}

// A peg of 50 mm, 100 mm deep in a hole of 52 mm.
static void peg_in_hole(robot *r, size_t joints, const robot_shape *peg, const robot_shape *block) {
  robot_bare(r, NSVCD_JOINT_PRISMATIC, (uint32_t)joints, 3, 1);
  for (size_t j = 0; j < joints; j++) {
    nsvcd_joint *joint = &r->joints[j];
    joint->axis[j % 3] = 1;
    joint->speed = joint->acceleration = 1;
    if (j < 3) continue;
    joint->kind = NSVCD_JOINT_REVOLUTE;
    joint->low = -3;
    joint->high = 3;
  }
  r->parts[0].body = peg->body;
  r->parts[0].link = (uint32_t)joints;
  r->parts[0].pose.position[2] = 0.15f;
  r->parts[1].body = r->parts[2].body = block->body;
  r->parts[2].pose.position[0] = 0.5f;
  robot_open(r);
}

// Out of one hole and into another, by three slides, with a wrist or without. Looks do not see that
// all edges are blocked but those along one slide: what it costs to find out is bounded by counts.
static void pegs_come_out_of_holes(void) {
  enum { SEEDS = 20 };
  static robot r;
  static asked_route a;
  shapes_mesh meshes[2];
  memset(meshes, 0, sizeof meshes);
  shapes_box(&meshes[0], 0.05, 0.05, 0.3, 1);
  for (int side = -1; side < 2; side += 2) {
    shapes_box_at(&meshes[1], side * 0.113, 0, 0.1, 0.174, 0.4, 0.2);
    shapes_box_at(&meshes[1], 0, side * 0.113, 0.1, 0.052, 0.174, 0.2);
  }
  robot_shape peg = shape_of(&meshes[0]);
  robot_shape block = shape_of(&meshes[1]);
  for (size_t joints = 3; joints <= 6; joints += 3) {
    size_t many = 0;
    size_t most[2] = {0, 0};
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
      peg_in_hole(&r, joints, &peg, &block);
      a.options.seed = seed;
      a.start[2] = a.goals[0][2] = 0.1;
      a.goals[0][0] = 0.5;
      ask_route(&r, &a);
      const size_t counts[2] = {a.answer.checks, a.answer.looks};
      for (int n = 0; n < 2; n++) most[n] = counts[n] > most[n] ? counts[n] : most[n];
      many += a.answer.checks > 300;
      CHECK_EQ(a.answer.status, NSVCD_ROUTE_FOUND);
      for (int k = 0; k <= 300 && a.answer.status == NSVCD_ROUTE_FOUND; k++) {
        double q[6];
        joints_at_time(&a.answer.motion, joints, a.answer.duration * k / 300, q);
        const placed at = placed_part(&r.scene, 0, q);
        const oracle_pose of_peg = oracle_of(&at);
        for (size_t n = 1; n < 3; n++) {
          const oracle_pose of_block = pose_widened(&r.parts[n].pose);
          const double apart =
              oracle_distance(&peg.exact, &of_peg, &block.exact, &of_block, NULL, NULL);
          CHECK(apart > 0);
        }
      }
      if (a.answer.status == NSVCD_ROUTE_FOUND)
        robot_motion_is_smooth(&r, &a.answer.motion, a.start, a.goals[0]);
      free(r.memory);
    }
    printf(
        "  %zu joints: at most %zu proofs, %zu looks; %zu of %d seeds take more than 300 proofs\n",
        joints, most[0], most[1], many, SEEDS);
    CHECK_LE(most[0], 1000);
    CHECK_LE(most[1], 1500);
    CHECK_LE(many, 2 * SEEDS / 5);
  }
  free(a.memory);
  free_shape(&peg);
  free_shape(&block);
}

void test_route_looks(void) {
  RUN(looks_have_parts_where_joints_say);
  RUN(routes_are_right_whatever_looks_say);
  RUN(looks_end_when_told);
  RUN(pairs_keep_their_clearances);
  RUN(pegs_come_out_of_holes);
}

CHECK_ALONE(test_route_looks)
