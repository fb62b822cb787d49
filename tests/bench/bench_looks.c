// bench_looks.c - nsvcd_look beside proofs of the same places: how long, and how often is it wrong?
//
//   build/bench_looks [PAIRS] [SEED]
//
// PAIRS (40) of random solids of about 0.3 m, 160 places each, near contact: at distances of the
// centres at which about half of the places are hits. Each place is proven (nsvcd_sweep of bodies at
// rest). Times are medians over the pairs, of one place.
#define _POSIX_C_SOURCE 200112L
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include "../../examples/scenery/oracle.h"
#include "../body_of.h"
#include "meter.h"

#define MOST_PAIRS 1000
#define BATCHES 10  // of NSVCD_LOOKS places
#define KINDS 6

static const size_t ball_counts[KINDS] = {0, 16, 64, 128, 256, 1024};

typedef struct look_tally {
  double times[MOST_PAIRS];
  double error;
  // at a margin of 0, and at minus the errors
  size_t missed[2], invented[2];
} look_tally;

// Two solids, and the places of the first about the second; what the proof says of them, and in
// what time.
typedef struct look_pair {
  shapes_mesh shapes[2];
  nsvcd_places away[BATCHES], here;
  int is_hit[BATCHES * NSVCD_LOOKS];
  double proof_time;
} look_pair;

// The body of a shape, which stays.
static const nsvcd_body *solid_of(const shapes_mesh *shape, size_t balls) {
  nsvcd_encode_options options;
  shapes_mesh copy = *shape;
  memset(&options, 0, sizeof options);
  options.balls = balls;
  return body_of(&copy, &options);
}

static void place_at(const oracle_pose *pose, nsvcd_places *places, size_t lane) {
  double m[9];
  oracle_matrix(pose->rotation, m);
  for (int k = 0; k < 9; k++) places->rotation[k][lane] = (float)m[k];
  for (int k = 0; k < 3; k++) places->position[k][lane] = (float)pose->position[k];
}

// Draws two solids and the places, and proves these.
static void prove_pair(look_pair *pair, shapes_rng *rng) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(512, 512, 64));
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd_question question;
  nsvcd_pose rests;
  double taken = 0;
  memset(&question, 0, sizeof question);
  for (int k = 0; k < 2; k++) {
    memset(&pair->shapes[k], 0, sizeof pair->shapes[k]);
    shapes_random_solid(&pair->shapes[k], rng, 0.3);
    (k ? &question.b : &question.a)->body = solid_of(&pair->shapes[k], 0);
  }
  question.a.poses = &rests;
  question.a.count = 1;
  for (size_t i = 0; i < BATCHES * NSVCD_LOOKS; i++) {
    oracle_pose pose;
    nsvcd_answer answer;
    shapes_quaternion(rng, pose.rotation);
    shapes_direction(rng, pose.position);
    const double reach = shapes_uniform(rng, 0.12, 0.32);
    for (int k = 0; k < 3; k++) pose.position[k] *= reach;
    place_at(&pose, &pair->away[i / NSVCD_LOOKS], i % NSVCD_LOOKS);
    place_at(&origin, &pair->here, i % NSVCD_LOOKS);
    for (int k = 0; k < 3; k++) rests.position[k] = (float)pose.position[k];
    for (int k = 0; k < 4; k++) rests.rotation[k] = (float)pose.rotation[k];
    const double began = seconds();
    if (nsvcd_sweep(&question, workspace, sizeof workspace, &answer)) exit(1);
    taken += seconds() - began;
    pair->is_hit[i] = answer.verdict == NSVCD_HIT;
  }
  pair->proof_time = 1e9 * taken / (BATCHES * NSVCD_LOOKS);
  nsvcd_body_free(question.a.body, NULL);
  nsvcd_body_free(question.b.body, NULL);
}

// Looks at all places of a pair by so many balls. Returns nanoseconds a place at a margin of 0.
static double look_at_pair(const look_pair *pair, size_t balls, look_tally *t) {
  nsvcd_looked looked[2];
  double error = 0;
  double time = 0;
  for (int k = 0; k < 2; k++) {
    looked[k].body = solid_of(&pair->shapes[k], balls);
    looked[k].scale = 0;
    error += (double)nsvcd_body_describe(looked[k].body).ball_error;
  }
  looked[1].places = &pair->here;
  t->error += error;
  for (int m = 0; m < 2; m++) {
    const nsvcd_look_options options = {m ? (float)-error : 0, 0};
    uint32_t met[BATCHES];
    double best = HUGE_VAL;
    for (int repeat = 0; repeat < 20; repeat++) {
      const double began = seconds();
      for (size_t i = 0; i < BATCHES; i++) {
        looked[0].places = &pair->away[i];
        if (nsvcd_look(&looked[0], &looked[1], &options, &met[i])) exit(1);
      }
      best = fmin(best, seconds() - began);
    }
    if (m == 0) time = 1e9 * best / (BATCHES * NSVCD_LOOKS);
    for (size_t i = 0; i < BATCHES * NSVCD_LOOKS; i++) {
      const int says = (int)(met[i / NSVCD_LOOKS] >> i % NSVCD_LOOKS & 1);
      t->missed[m] += pair->is_hit[i] && !says;
      t->invented[m] += says && !pair->is_hit[i];
    }
  }
  for (int k = 0; k < 2; k++) nsvcd_body_free(looked[k].body, NULL);
  return time;
}

int main(int argc, char **argv) {
  static look_tally tallies[KINDS];
  static double proof_times[MOST_PAIRS];
  static look_pair pair;
  const size_t asked = argc > 1 ? (size_t)atoi(argv[1]) : 40;
  const size_t pairs = asked < MOST_PAIRS ? asked : MOST_PAIRS;
  const double all = (double)(pairs * BATCHES * NSVCD_LOOKS);
  shapes_rng rng = {argc > 2 ? (uint64_t)atoi(argv[2]) : 1};
  size_t hits = 0;
  for (size_t n = 0; n < pairs; n++) {
    prove_pair(&pair, &rng);
    proof_times[n] = pair.proof_time;
    for (size_t i = 0; i < BATCHES * NSVCD_LOOKS; i++) hits += (size_t)pair.is_hit[i];
    for (int kind = 0; kind < KINDS; kind++)
      tallies[kind].times[n] = look_at_pair(&pair, ball_counts[kind], &tallies[kind]);
    for (int k = 0; k < 2; k++) shapes_free(&pair.shapes[k]);
  }
  meter_sort(proof_times, pairs);
  printf("%.0f places, %.0f %% of them hits; a proof: %.0f ns\n\n", all, 100 * (double)hits / all,
         proof_times[pairs / 2]);
  printf(
      "| balls | ns a place | errors of both, mm | margin 0: missed, invented | less the errors "
      "|\n");
  printf("|---|---|---|---|---|\n");
  for (int kind = 0; kind < KINDS; kind++) {
    look_tally *t = &tallies[kind];
    meter_sort(t->times, pairs);
    printf("| %zu | %.0f | %.1f | %.2f %%, %.1f %% | %.1f %%, %.2f %% |\n", ball_counts[kind],
           t->times[pairs / 2], 1e3 * t->error / (double)pairs, 100 * (double)t->missed[0] / all,
           100 * (double)t->invented[0] / all, 100 * (double)t->missed[1] / all,
           100 * (double)t->invented[1] / all);
  }
  return 0;
}
