// own.c - bodies of your own on a microcontroller: does A hit B? The Makefile (`own`) bakes two meshes,
// builds this for Cortex-M4F, runs it under QEMU and on the host, and prints what it takes.
//
// A moves from FROM to TO, x,y,z in metres (after SCALE), without turning; or, without these, straight through the
// middle of B's box, along the axis along which B is thinnest. What it says is what a program of your
// own would ask: change this one.
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include "board.h"
#include "bodies.h"  // a_body, b_body and BODIES_PATCHES, by bake.c
#include "print.h"

#define SEGMENTS 16  // fewer than the default of 64 take less memory

static NSVCD_MEMORY(workspace,
                    NSVCD_PROOF_WORKSPACE_BYTES(BODIES_PATCHES, BODIES_PATCHES, SEGMENTS));

// Fills in where A is at the start and at the end.
static void make_path(const nsvcd_body_facts *a, const nsvcd_body_facts *b, nsvcd_pose *path) {
  memset(path, 0, 2 * sizeof *path);
  path[0].rotation[3] = path[1].rotation[3] = 1;
#ifdef FROM
  const float from[3] = {FROM};
  const float to[3] = {TO};
  memcpy(path[0].position, from, sizeof from);
  memcpy(path[1].position, to, sizeof to);
  (void)a, (void)b;
#else
  const float to_centre[3] = {b->centre[0] - a->centre[0], b->centre[1] - a->centre[1],
                              b->centre[2] - a->centre[2]};
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (b->high[k] - b->low[k] < b->high[axis] - b->low[axis]) axis = k;
  for (int end = 0; end < 2; end++) {
    for (int k = 0; k < 3; k++) path[end].position[k] = to_centre[k];
    path[end].position[axis] += (end ? -1.1f : 1.1f) * (a->radius + b->radius);
  }
#endif
}

static int say(const nsvcd_body *a, const nsvcd_body *b) {
  static nsvcd_answer answer;
  nsvcd_question question = {0};
  nsvcd_pose path[2];
  const nsvcd_body_facts a_facts = nsvcd_body_describe(a);
  const nsvcd_body_facts b_facts = nsvcd_body_describe(b);
  make_path(&a_facts, &b_facts, path);
  question.a.body = a;
  question.a.poses = path;
  question.a.count = 2;
  question.b.body = b;
  question.segments = SEGMENTS;
  question.ask = NSVCD_ASK_FIRST;
  const int measures = board_measures();
  board_stack_paint();
  const uint64_t before = board_instructions();
  const nsvcd_result result = nsvcd_sweep(&question, workspace, sizeof workspace, &answer);
  const uint64_t taken = board_instructions() - before;
  board_print(result ? nsvcd_result_string(result) : nsvcd_verdict_string(answer.verdict));
  if (!result && answer.verdict == NSVCD_HIT) {
    board_print(answer.inside ? ", inside, at " : ", at ");
    print_number((uint64_t)(1000 * answer.time.high));
    board_print(" thousandths of the motion");
  }
  board_print("\n");
  if (measures) {
    print_measurement("own", "workspace", sizeof workspace);
    print_measurement("own", "stack", board_stack_used());
    print_measurement("own", "mean", taken);
    print_measurement("own", "worst", taken);
  }
  return result != NSVCD_OK;
}

int main(void) {
  const nsvcd_body *a;
  const nsvcd_body *b;
  nsvcd_result result = nsvcd_body_trust(a_body, sizeof a_body, &a);
  if (!result) result = nsvcd_body_trust(b_body, sizeof b_body, &b);
  if (!result) return say(a, b);
  board_print(nsvcd_result_string(result));
  board_print("\n");
  return 1;
}
