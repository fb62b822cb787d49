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

#define QUESTIONS 32
#define POSES 4      // of a motion, at most
#define SEGMENTS 16  // fewer than the default of 64 take less memory
#define PAIRS NSVCD_DEFAULT_PAIRS

#ifdef NSVCD_NO_PROOF
#define WORKSPACE_BYTES \
  NSVCD_NETWORK_WORKSPACE_BYTES(BODIES_PATCHES, BODIES_PATCHES, SEGMENTS, PAIRS)
#else  // enough for the network, too, which needs less
#define WORKSPACE_BYTES NSVCD_PROOF_WORKSPACE_BYTES(BODIES_PATCHES, BODIES_PATCHES, SEGMENTS)
#endif
static NSVCD_MEMORY(workspace, WORKSPACE_BYTES);

// ------------------------------------------------------------------------------------------ output

static void print_number(uint64_t number) {
  char text[21];
  char *digit = text + sizeof text - 1;
  *digit = 0;
  do {
    *--digit = (char)('0' + number % 10);
    number /= 10;
  } while (number > 0);
  board_print(digit);
}

static void print_measurement(const char *method, const char *what, uint64_t amount) {
  board_print("# ");
  board_print(method);
  board_print(" ");
  board_print(what);
  board_print(" ");
  print_number(amount);
  board_print("\n");
}

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

// --------------------------------------------------------------------------------------- questions
// The same on every machine, to the bit: integers, and of floats only + * / and sqrtf. For that the
// compiler must not fuse * and +, which gcc does not with -std=c99.

// In -1..1.
static float random_of(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)((int32_t)(*seed >> 16) - 32768) / 32768;
}

static nsvcd_pose pose_of(float x, float y, float z, float qx, float qy, float qz, float qw) {
  const float length = sqrtf(qx * qx + qy * qy + qz * qz + qw * qw);
  const nsvcd_pose pose = {{x, y, z}, {qx / length, qy / length, qz / length, qw / length}};
  return pose;
}
static nsvcd_pose upright(float x, float y, float z) {
  return pose_of(x, y, z, 0, 0, 0, 1);
}

// Somewhere in or around the rack, which is 0.4 m long, 0.3 m deep and 0.12 m high.
static nsvcd_pose random_pose(uint32_t *seed) {
  const float x = 0.30f * random_of(seed);
  const float y = 0.25f * random_of(seed);
  const float z = 0.15f + 0.15f * random_of(seed);
  const float qx = 0.5f * random_of(seed);
  const float qy = 0.5f * random_of(seed);
  const float qz = random_of(seed);
  return pose_of(x, y, z, qx, qy, qz, 1);
}

// Fills in how the mug, a, and the rack, b, move. poses, b_poses: (POSES).
static void pose_question(uint32_t number, nsvcd_pose *poses, nsvcd_pose *b_poses,
                          nsvcd_question *question) {
  uint32_t seed = number * 2654435769u;
  const float step = (float)(number / 8);  // 0, 1, 2, 3
  question->a.poses = poses;
  question->a.count = 2;
  switch (number % 8) {
    case 0:  // along the front of the rack, 1.5 mm too near up to 1.5 mm off
    case 1:  // the same while the mug turns about its axis
      poses[0] = upright(-0.3f, -0.1925f - 0.001f * step, 0.001f);
      poses[1] = upright(0.3f, -0.1925f - 0.001f * step, 0.001f);
      if (number % 8 == 1) poses[1] = pose_of(0.3f, -0.1925f - 0.001f * step, 0.001f, 0, 0, 1, 1);
      break;
    case 2:  // across its highest bars, 1.5 mm too low up to 1.5 mm off
      poses[0] = upright(-0.3f, 0.11f, 0.1197f + 0.001f * step);
      poses[1] = upright(0.3f, 0.12f, 0.1197f + 0.001f * step);
      break;
    case 3:  // let down into it
      poses[0] = random_pose(&seed);
      poses[0].position[2] = 0.3f;
      poses[1] = poses[0];
      poses[1].position[2] = 0.03f * step;
      break;
    case 4:  // a mug of 2 mm that stays within a bar of the rack, or goes on through its surface
      question->a.scale = 0.02f;
      poses[0] = upright(-0.1f, -0.15f, 0.002f);
      poses[1] = pose_of(0.1f, -0.15f + 0.002f * step, 0.002f, 0, 0, 1, 1);
      break;
    case 5:  // both move
      b_poses[0] = upright(0, 0, 0);
      b_poses[1] = pose_of(0, 0.1f, 0.1f, 0.2f, 0, 0, 1);
      question->b.poses = b_poses;
      question->b.count = 2;
      poses[0] = random_pose(&seed);
      poses[1] = random_pose(&seed);
      break;
    default:  // three or four poses anywhere, the more the higher
      question->a.count = 3 + number % 2;
      for (size_t i = 0; i < question->a.count; i++) {
        poses[i] = random_pose(&seed);
        poses[i].position[2] += 0.04f * step;
      }
  }
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
    nsvcd_pose poses[POSES];
    nsvcd_pose b_poses[POSES];
    static nsvcd_answer answer;  // 380 bytes
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
