// game.c - a level at 60 Hz, without a screen: 50 props, most of them concave, fall into a pit and
// pile up, a character walks stairs, a ramp and hills, and needles are shot at 100 m/s. All are
// movers of an nsvcd_world, and every move is proven free before it is made.
// Prints what a frame costs; draws build/game.svg.
//
//   build/game [--frames N] [--seed N] [--check] [--problems FOLDER]
//
// --check holds all poses against the oracle, now and then and at the end; --problems writes some
// of the ways that things are about to go as a problem file. Both, and the picture, are in
// scenery/game_watch.h: a game has no use for them.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../extras/neuralsvcd_world.h"
#define PROGRAM "game"
#include "scenery/problem_file.h"
#include "scenery/level.h"
#include "scenery/props.h"

#define PROPS 50
#define NEEDLES 10           // the most at a time
enum { CHARACTER = PROPS };  // which of the movers it is; needles come after
#define MOVERS (PROPS + 1 + NEEDLES)
#define THINGS (MOVERS + 2)  // bodies: the level, and a needle that is about to be gone
enum { NEEDLE = LEVEL_PROPS, LEVEL, WALKER, SHAPES };

#define FRAME (1.0f / 60)
#define GAP 0.002f   // metres: things never come nearer to each other
#define BOLT 100.0f  // metres a second
#define CAPSULE_RADIUS 0.25f
#define CAPSULE_HALF 0.55f  // metres: half its axis
#define SPEED 1.6f          // metres a second, walking

// The character's route: up the stairs, down the ramp, over the hills.
static const float route[][2] = {{-3.4f, -2}, {-0.2f, -2}, {3.9f, -2}, {3.4f, 1}, {2.4f, 2.6f}};
#define STOPS (sizeof route / sizeof *route)

typedef struct game {
  shapes_mesh meshes[SHAPES];
  props_shape shapes[SHAPES];
  size_t parts[4];  // triangles of the level: ground, things on it, what is built
  nsvcd_world *world;
  void *workspace;
  size_t workspace_size;
  nsvcd_world_mover movers[MOVERS];
  size_t count, shots;    // movers that are there; needles that were shot
  int kinds[THINGS + 1];  // by ids
  float scales[THINGS + 1];
  size_t stop;  // the stop of the route that the character is going to
  shapes_rng rng;
  size_t frames, frame;
  double *frame_ms;
  double questions, contacts;
} game;

#include "scenery/game_watch.h"

// A capsule is no mesh, but round: one that fits into it is drawn, and held against the oracle.
static int make_shapes(game *g) {
  const float from[3] = {0, 0, -CAPSULE_HALF};
  const float to[3] = {0, 0, CAPSULE_HALF};
  make_meshes(g->meshes, 64);
  level_with_pit(&g->meshes[LEVEL], g->parts);
  for (size_t k = 0; k <= LEVEL; k++)
    if (props_encode(&g->meshes[k], k == LEVEL ? 0.1f : 0, &g->shapes[k])) return 0;
  return !nsvcd_encode_capsule(from, to, CAPSULE_RADIUS, NULL, &g->shapes[WALKER].body);
}

// Puts a thing there. Without a mass it never moves.
static size_t put(game *g, int kind, float scale, float mass, const nsvcd_pose *pose) {
  const size_t id = props_add(g->world, &g->shapes[kind], scale, mass, pose);
  g->kinds[id] = kind;
  g->scales[id] = scale;
  return id;
}

static int is_free(const game *g, const nsvcd_world_mover *m) {
  return m->id && props_is_free(g->world, m, g->workspace, g->workspace_size);
}

static nsvcd_pose pose_at(float x, float y, float z) {
  const nsvcd_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  return pose;
}

// Makes the level, props in the air, in layers, and the character.
static int fill_world(game *g) {
  static const float scales[4] = {0.8f, 1, 1.2f, 1.5f};
  const nsvcd_pose origin = pose_at(0, 0, 0);
  const nsvcd_pose start = pose_at(-5, -2, 1.5f);
  const size_t size = nsvcd_world_size(THINGS);
  g->workspace_size = nsvcd_sweep_workspace_size(NULL);
  g->workspace = allocate(g->workspace_size);
  if (nsvcd_world_begin(allocate(size), size, THINGS, &g->world)) return 0;
  if (!put(g, LEVEL, 1, 0, &origin)) return 0;
  for (size_t i = 0; i < PROPS; i++) {
    double q[4];
    const int kind = (int)i % LEVEL_PROPS;
    const float scale = scales[shapes_pick(&g->rng, 4)];
    const float mass = 5 * scale * scale * scale;
    nsvcd_pose pose = pose_at(-0.7f + 0.7f * (float)(i % 3), 0.4f + 0.7f * (float)(i / 3 % 3),
                              1 + 0.85f * (float)(i / 9));
    shapes_quaternion(&g->rng, q);
    for (int k = 0; k < 4; k++) pose.rotation[k] = (float)q[k];
    nsvcd_world_mover *m = &g->movers[i];
    *m = props_mover(put(g, kind, scale, mass, &pose), &g->shapes[kind], scale, mass, GAP);
    m->velocity.linear[0] = (float)shapes_uniform(&g->rng, -0.5, 0.5);
    m->velocity.angular[1] = (float)shapes_uniform(&g->rng, -3, 3);
    if (!is_free(g, m)) return 0;
  }
  g->movers[CHARACTER] = props_character(put(g, WALKER, 1, 1, &start), 40, 0.25f);
  g->count = CHARACTER + 1;
  return is_free(g, &g->movers[CHARACTER]);
}

// The character goes to the next stop.
static void walk(game *g) {
  float *velocity = g->movers[CHARACTER].velocity.linear;
  const float *at = g->movers[CHARACTER].answer.pose.position;
  velocity[0] = velocity[1] = 0;
  if (g->frame == 0 || g->stop == STOPS) return;
  const float x = route[g->stop][0] - at[0];
  const float y = route[g->stop][1] - at[1];
  const float length = sqrtf(x * x + y * y);
  if (length < 0.1f) g->stop++;
  velocity[0] = x * SPEED / fmaxf(length, 0.1f);
  velocity[1] = y * SPEED / fmaxf(length, 0.1f);
}

// Shoots a needle from somewhere above at one of the props. The oldest needle is gone then.
static void shoot(game *g) {
  const float *prop = g->movers[shapes_pick(&g->rng, PROPS)].answer.pose.position;
  nsvcd_pose pose = pose_at((float)shapes_uniform(&g->rng, -3, 3), 4, 3.5f);
  float way[3], square = 0;
  for (int k = 0; k < 3; k++) {
    way[k] = prop[k] - pose.position[k];
    square += way[k] * way[k];
  }
  for (int k = 0; k < 3; k++) way[k] /= sqrtf(square);
  // its point, at the end of its z, goes ahead
  const float w = sqrtf(0.5f * (1 + way[2]));
  pose.rotation[0] = -0.5f * way[1] / w;
  pose.rotation[1] = 0.5f * way[0] / w;
  pose.rotation[3] = w;
  const size_t id = put(g, NEEDLE, 1, 0.05f, &pose);
  nsvcd_world_mover needle = props_mover(id, &g->shapes[NEEDLE], 1, 0.05f, GAP);
  for (int k = 0; k < 3; k++) needle.velocity.linear[k] = BOLT * way[k];
  nsvcd_world_mover *oldest = &g->movers[CHARACTER + 1 + g->shots % NEEDLES];
  const int has_room = is_free(g, &needle);
  (void)nsvcd_world_remove(g->world, has_room ? oldest->id : id);
  if (!has_room) return;
  *oldest = needle;
  g->shots++;
  if (g->count < MOVERS) g->count++;
}

static int play(game *g, watch *w) {
  nsvcd_step_options options;
  nsvcd_step_answer answer;
  memset(&options, 0, sizeof options);
  options.gravity[2] = -9.81f;
  for (g->frame = 0; g->frame < g->frames; g->frame++) {
    if (g->frame % 60 == 59) shoot(g);
    walk(g);
    watch_frame(g, w);
    const double start = seconds();
    const nsvcd_result result = nsvcd_world_step(g->world, g->movers, g->count, &options, FRAME,
                                                 g->workspace, g->workspace_size, &answer);
    g->frame_ms[g->frame] = 1e3 * (seconds() - start);
    if (result) return complain("frame %zu: %s", g->frame, nsvcd_result_string(result));
    g->questions += (double)answer.questions;
    g->contacts += (double)answer.contacts;
  }
  return 1;
}

int main(int argc, char **argv) {
  static game g;
  static watch w;
  size_t seed = 2026;
  g.frames = 600;
  if (!read_options(&g, &w, argc, argv, &seed)) return USAGE;
  g.frame_ms = (double *)allocate(g.frames * sizeof(double));
  g.rng.state = seed;
  if (!make_shapes(&g)) return complain("out of memory"), REFUSED;
  if (!watch_begin(&g, &w))
    return complain("%s: problems cannot be written there", w.folder), REFUSED;
  if (!fill_world(&g)) return complain("no room for the props, or no memory"), REFUSED;
  const int good = play(&g, &w) && watch_end(&g, &w);
  for (size_t k = 0; k < SHAPES; k++) {
    nsvcd_body_free(g.shapes[k].body, NULL);
    shapes_free(&g.meshes[k]);
  }
  free(g.world);
  free(g.workspace);
  free(g.frame_ms);
  return good ? DONE : REFUSED;
}
