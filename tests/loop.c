// loop.c - the loop of examples/README.md, word by word: tests/examples.sh puts it into loop.inc. A
// box of half a metre, as a prop and as a character, on a floor, beside a wall, in a corner and on
// an elevator, held against what paper says of it.
#define NEURALSVCD_IMPLEMENTATION
#include "neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "extras/neuralsvcd_world.h"
#include <stdio.h>
#include <stdlib.h>

#define HALF 0.25     // metres: of the box
#define APART 0.0005  // clearance, and margin: so it rests at twice that
#define PUSH 2.0f     // metres a second in a second
#define MOST 4

enum { FLOOR, SLIDE, WALL, CORNER, ELEVATOR, SCENES };
static const char *const names[SCENES] = {"floor", "rough floor", "wall", "corner", "elevator"};

// What the loop uses is below; this is what `next_frame` does.
static int scene, is_character, frame, frames, failures;
static size_t lift;
static nsvcd_velocity velocity[1];
static nsvcd_slide_options how[1];
static nsvcd_slide_answer answer[1];

static void expect(const char *what, double is, double wanted, double within) {
  if (is >= wanted - within && is <= wanted + within) return;
  printf("%s, %s, frame %d: %s is %.6f, not %.6f\n", names[scene],
         is_character ? "character" : "prop", frame, what, is, wanted);
  failures++;
}

// How high the elevator is: up at 2 m/s for 3 s, at rest for a second, down at 1 m/s for 2 s, and at
// rest again.
static double height(int k) {
  const double t = k / 60.0;
  return t < 3 ? 2 * t : t < 4 ? 6 : t < 6 ? 6 - (t - 4) : 4;
}

// Holds the frame before against the box's gaps, and pushes.
static int next_frame(nsvcd_world *world) {
  const float *at = answer[0].pose.position;
  const double floor = scene == ELEVATOR ? height(frame) : 0;
  if (frame > 0) {
    const double least = APART - 1e-6 * (1 + floor);
    if ((double)at[2] - HALF - floor < least)
      expect("gap to the floor", at[2] - HALF - floor, 1, 0);
    if (scene >= WALL && scene <= CORNER && 1 - HALF - (double)at[0] < least)
      expect("gap to the wall", 1 - HALF - at[0], 1, 0);
    if (scene == CORNER && 1 - HALF - (double)at[1] < least)
      expect("gap to the corner", 1 - HALF - at[1], 1, 0);
    if (answer[0].caught) expect("caught", (double)answer[0].caught, 0, 0);
  }
  if (frame == frames) return 0;
  frame++;
  if (scene == WALL || scene == CORNER) velocity[0].linear[0] += PUSH / 60;
  if (scene == CORNER) velocity[0].linear[1] += PUSH / 60;
  if (scene == WALL) velocity[0].linear[1] = 0.5f;
  if (scene != ELEVATOR) return 1;
  const nsvcd_pose to = {{0, 0, (float)height(frame) - 0.5f}, {0, 0, 0, 1}};
  return nsvcd_world_drive(world, lift, &to) == NSVCD_OK;
}

static size_t add(nsvcd_world *world, float x, float y, float z, float hx, float hy, float hz,
                  int is_fixed) {
  const float half[3] = {hx, hy, hz};
  const nsvcd_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  nsvcd_world_body body;
  size_t id = 0;
  memset(&body, 0, sizeof body);
  body.pose = pose;
  body.fixed = is_fixed;
  if (nsvcd_encode_box(half, 0, NULL, &body.body) || nsvcd_world_add(world, &body, &id)) exit(1);
  return id;
}

static int play(void) {
  const float seconds = 1.0f / 60;
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(size);
  void *memory = malloc(nsvcd_world_size(MOST));
  const size_t count = 1;
  size_t id[1];
  nsvcd_world *world;
  if (!workspace || nsvcd_world_begin(memory, nsvcd_world_size(MOST), MOST, &world)) return 1;
  lift = add(world, 0, 0, -0.5f, 20, 20, 0.5f, scene != ELEVATOR);
  if (scene == WALL || scene == CORNER) add(world, 1.5f, 0, 1, 0.5f, 20, 1.5f, 1);
  if (scene == CORNER) add(world, -0.5f, 1.5f, 1, 1.4f, 0.5f, 1.5f, 1);
  id[0] = add(world, 0, 0, HALF + 2 * APART + (scene == FLOOR ? 1 : 0), HALF, HALF, HALF, 0);
#include "loop.inc"
  free(memory);
  free(workspace);
  return 0;
}

// What paper says of the end.
static void check(void) {
  const float *at = answer[0].pose.position;
  const float *v = velocity[0].linear;
  const double floor = scene == ELEVATOR ? height(frame) : 0;
  const double wall = 1 - HALF - 2 * APART;
  expect("height", at[2], floor + HALF + 2 * APART, 0.6 * APART);
  expect("speed down", v[2], 0, 1e-3);
  if (scene == FLOOR) expect("way", at[0], 2 * frame / 60.0, 1e-3);  // nothing slows it down
  if (scene == SLIDE) expect("way", at[0], 2 * 2 / (2 * 0.5 * 9.81), 0.02);
  if (scene == SLIDE) expect("rests", answer[0].rests, 1, 0);
  if (scene == WALL || scene == CORNER) expect("wall", at[0], wall, 0.6 * APART);
  if (scene == WALL) expect("way", at[1], 0.5 * frame / 60, 2e-3);
  if (scene == CORNER) expect("corner", at[1], wall, 0.6 * APART);
  if (scene == CORNER) expect("speed", v[0] + v[1], 0, 1e-3);
  if (scene == ELEVATOR) expect("way", fabs((double)at[0]) + fabs((double)at[1]), 0, 1e-6);
  if (is_character) expect("stands", answer[0].ground == lift, 1, 0);
}

int main(void) {
  for (scene = 0; scene < SCENES; scene++)
    for (is_character = 0; is_character < 2; is_character++) {
      if (scene == SLIDE && is_character) continue;
      memset(velocity, 0, sizeof velocity);
      memset(how, 0, sizeof how);
      memset(answer, 0, sizeof answer);
      how[0].clearance = how[0].margin = (float)APART;
      if (is_character) how[0].up[2] = 1;
      if (!is_character) how[0].mass = 2;
      if (scene == SLIDE) how[0].friction = 0.5f;
      if (scene == FLOOR || scene == SLIDE) velocity[0].linear[0] = 2;
      frame = 0;
      frames = scene == ELEVATOR ? 420 : 180;
      if (play()) return printf("%s: refused\n", names[scene]), 1;
      check();
    }
  if (!failures) printf("the loop does what paper says\n");
  return failures != 0;
}
