// firmware.c - collision checks on a microcontroller: bodies in flash, no heap, no files, no stdio.
//
// A mug is moved past a dish rack in 32 ways. A line each says what came of it: method, number,
// verdict, and whether that is proven. Lines that begin with # are measurements, by the board alone.
// The Makefile builds this for Cortex-M and for the host, and holds the answers of the one against
// those of the other.
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include "board.h"
#include "bodies.h"  // mug_body, dish_rack_body and BODIES_PATCHES, by bake.c
#include "print.h"
#include "questions.h"

#define SEGMENTS 16  // fewer than the default of 64 take less memory
#define PAIRS NSVCD_DEFAULT_PAIRS

#ifdef NSVCD_NO_PROOF
#define WORKSPACE_BYTES \
  NSVCD_NETWORK_WORKSPACE_BYTES(BODIES_PATCHES, BODIES_PATCHES, SEGMENTS, PAIRS)
#else  // enough for the network, too, which needs less
#define WORKSPACE_BYTES NSVCD_PROOF_WORKSPACE_BYTES(BODIES_PATCHES, BODIES_PATCHES, SEGMENTS)
#endif
static NSVCD_MEMORY(workspace, WORKSPACE_BYTES);

static void print_answer(const char *method, uint32_t number, const nsvcd_answer *answer) {
  board_print(method);
  board_print(" ");
  print_number(number);
  board_print(" ");
  board_print(nsvcd_verdict_string(answer->verdict));
  if (answer->inside) board_print(" inside");
  if (answer->opinion.limited) board_print(" limited");
  board_print(answer->by == NSVCD_BY_PROOF ? " proof\n" : " opinion\n");
}

// -------------------------------------------------------------------------------------------- asks

// Asks all questions by one method. Returns 0, with a message, if one is refused.
static int ask_all(const char *name, nsvcd_method method, const nsvcd_body *mug,
                   const nsvcd_body *rack) {
  const int measures = board_measures();
  uint64_t sum = 0;
  uint64_t most = 0;
  board_stack_paint();
  for (uint32_t i = 0; i < QUESTIONS; i++) {
    // not on the stack, where a board has little: 168 and 380 bytes
    static nsvcd_pose poses[POSES], b_poses[B_POSES];
    static nsvcd_answer answer;
    nsvcd_question question = {0};
    question.a.body = mug;
    question.b.body = rack;
    question.method = method;
    question.segments = SEGMENTS;
    question.network.pairs = PAIRS;
    pose_question(i, poses, b_poses, &question);

    const uint64_t before = board_instructions();
    const nsvcd_result result = nsvcd_sweep(&question, workspace, sizeof workspace, &answer);
    const uint64_t taken = board_instructions() - before;
    if (result) {
      board_print(nsvcd_result_string(result));
      board_print("\n");
      return 0;
    }
    sum += taken;
    if (taken > most) most = taken;
    print_answer(name, i, &answer);
  }
  if (measures) {
    print_measurement(name, "workspace", sizeof workspace);
    print_measurement(name, "bodies", sizeof mug_body + sizeof dish_rack_body);
    print_measurement(name, "stack", board_stack_used());
    print_measurement(name, "mean", sum / QUESTIONS);
    print_measurement(name, "worst", most);
  }
  return 1;
}

int main(void) {
  const nsvcd_body *mug;
  const nsvcd_body *rack;
  // What is in flash is as trustworthy as the code: only its header is looked at, nothing copied.
  nsvcd_result result = nsvcd_body_trust(mug_body, sizeof mug_body, &mug);
  if (!result) result = nsvcd_body_trust(dish_rack_body, sizeof dish_rack_body, &rack);
  if (result) {
    board_print(nsvcd_result_string(result));
    board_print("\n");
    return 1;
  }
#ifndef NSVCD_NO_PROOF
  if (!ask_all("proof", NSVCD_METHOD_PROOF, mug, rack)) return 1;
#endif
#ifndef NSVCD_NO_NETWORK
  if (!ask_all("network", NSVCD_METHOD_NETWORK, mug, rack)) return 1;
#endif
  return 0;
}
