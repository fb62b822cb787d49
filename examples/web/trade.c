// trade.c - motions that nearly touch, and what fast checks say of them, as a WebAssembly module for
// trade_answers.js: the library, and the benchmark's mesh hierarchy, which looks at samples of a motion.
//
// The module imports nothing, not even a clock. trade_answers.js reads the structs in linear memory.
#define NSVCD_NO_STDIO
#define NSVCD_NO_INT8
#define NSVCD_NO_GRADIENT
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../../tests/arrays.h"
#include "../../tests/bench/sampler.h"
#include "../scenery/shapes.h"

const method *trade_hierarchy(void);  // trade_mesh.c

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { MUG, RACK, PLATE, MESHES };
enum { COUNT = 400 };  // motions of a set: every other one hits
enum { STEPS = 8 };    // of the search for where the verdict changes
#define LEAST 1e-4     // metres: how far a motion is moved from there at least
#define SPREAD 0.01    // metres: the standard deviation of how much farther

typedef struct part {
  nsvcd_mesh mesh;
  const nsvcd_body *body;
  const nsvcd_body *latents;  // for the network; NULL: not yet encoded
  void *tree;                 // the hierarchy's
} part;

// How the motions of a set come about: from somewhere in a box to somewhere in another one.
typedef struct set {
  int moving, fixed;            // B rests at the origin
  double from[2][3], to[2][3];  // corners, metres
  int on_edge;                  // a plate, as it stands in the rack; else as it lies
  double tilt, turn;            // degrees: the most before the motion, and during it
  double aside;                 // metres: the most by which it is moved until its verdict changes
} set;

// In the order of trade_answers.js: a plate past the rack, a mug past a mug, a mug through the rack,
// a plate into a slot of it.
// clang-format off
static const set sets[] = {
    {PLATE, RACK, {{-0.45, -0.2, 0}, {-0.25, 0.2, 0.25}}, {{0.25, -0.2, 0}, {0.45, 0.2, 0.25}},
     1, 30, 40, 0.2},
    {MUG, MUG, {{-0.4, -0.1, -0.1}, {-0.2, 0.1, 0.1}}, {{0.2, -0.1, -0.1}, {0.4, 0.1, 0.1}},
     0, 180, 120, 0.2},
    {MUG, RACK, {{-0.35, -0.06, 0.01}, {-0.25, 0.06, 0.1}}, {{0.25, -0.06, 0.01}, {0.35, 0.06, 0.1}},
     0, 30, 60, 0.06},
    {PLATE, RACK, {{-0.15, -0.1, 0.2}, {0.15, 0.1, 0.35}}, {{-0.15, -0.05, 0.1}, {0.15, 0.05, 0.15}},
     1, 15, 30, 0.1},
};
// clang-format on

// As trade_answers.js reads it.
typedef struct trial {
  nsvcd_pose motion[2];  // A's
  int hits;              // by proof
} trial;

static part parts[MESHES];
static const set *chosen;
static part *moving, *fixed;
static shapes_rng rng;
static trial trials[COUNT];
static uint8_t said[COUNT];  // of each motion: 1, it hits
static nsvcd_pose motion[2];
static nsvcd_answer answer;
static void *workspace;
static size_t workspace_size;

// ------------------------------------------------------------------------------------------- bodies

char *EXPORT(trade_text)(size_t size) {
  return (char *)malloc(size);
}

// Reads a mesh from an OBJ text in memory of trade_text, which it gives back.
nsvcd_result EXPORT(trade_read)(size_t which, char *text, size_t size) {
  part *p = &parts[which];
  nsvcd_result result = nsvcd_obj_parse(text, size, NULL, &p->mesh, NULL);
  free(text);
  if (!result) result = nsvcd_encode(&p->mesh, NULL, NULL, NULL, 0, &p->body);
  if (result) return result;
  workspace_size = nsvcd_sweep_workspace_size(NULL);
  if (!workspace) workspace = malloc(workspace_size);
  p->tree = trade_hierarchy()->prepare(&p->mesh, NULL);
  return workspace && p->tree ? NSVCD_OK : NSVCD_ERROR_MEMORY;
}

// A body for the network alone, of as many patches as it wants.
static nsvcd_result add_latents(part *p) {
  nsvcd_encode_options options = {0};
  options.patches = NSVCD_DEFAULT_NETWORK_PATCHES;
  options.latents = options.no_triangles = 1;
  return p->latents ? NSVCD_OK : nsvcd_encode(&p->mesh, &options, NULL, NULL, 0, &p->latents);
}

// ------------------------------------------------------------------------------------------ motions

static nsvcd_question make_question(const nsvcd_pose *poses) {
  nsvcd_question question = {0};
  question.a.body = moving->body;
  question.a.poses = poses;
  question.a.count = 2;
  question.b.body = fixed->body;
  return question;
}

typedef struct sketch {
  double from[3], to[3], start[4], end[4];
  double aside[3];
} sketch;

static void turn(const double *axis, double degrees, double *q) {
  const double half = degrees * SHAPES_PI / 360;
  for (int k = 0; k < 3; k++) q[k] = axis[k] * sin(half);
  q[3] = cos(half);
}
static void multiply(const double *a, const double *b, double *out) {  // by b, then by a
  for (int k = 0; k < 3; k++) {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    out[k] = a[3] * b[k] + b[3] * a[k] + a[u] * b[v] - a[v] * b[u];
  }
  out[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}
static void draw(shapes_rng *rng, const set *s, sketch *out) {
  static const double up[3] = {0, 1, 0};
  double axis[3], stands[4], by[4];
  for (int k = 0; k < 3; k++) out->from[k] = shapes_uniform(rng, s->from[0][k], s->from[1][k]);
  for (int k = 0; k < 3; k++) out->to[k] = shapes_uniform(rng, s->to[0][k], s->to[1][k]);
  turn(up, s->on_edge ? 90 : 0, stands);
  shapes_direction(rng, axis);
  turn(axis, shapes_uniform(rng, 0, s->tilt), by);
  multiply(by, stands, out->start);
  shapes_direction(rng, axis);
  turn(axis, shapes_uniform(rng, 0, s->turn), by);
  multiply(by, out->start, out->end);
  shapes_direction(rng, out->aside);
  for (int k = 0; k < 3; k++) out->aside[k] *= s->aside;
}

// Whether the sketch hits if it is moved aside by that share; -1: unknown.
static int hits(const sketch *s, double share, nsvcd_pose *out) {
  for (int k = 0; k < 3; k++) {
    out[0].position[k] = (float)(s->from[k] + share * s->aside[k]);
    out[1].position[k] = (float)(s->to[k] + share * s->aside[k]);
  }
  for (int k = 0; k < 4; k++) {
    out[0].rotation[k] = (float)s->start[k];
    out[1].rotation[k] = (float)s->end[k];
  }
  const nsvcd_question question = make_question(out);
  if (nsvcd_sweep(&question, workspace, workspace_size, &answer)) return -1;
  return answer.verdict == NSVCD_UNDECIDED ? -1 : answer.verdict == NSVCD_HIT;
}

// Moves a sketch aside to where its verdict changes, and from there so far that it is as wanted.
static int nearly_touches(shapes_rng *rng, const set *s, const sketch *of, trial *out) {
  double there[2] = {0, 1};  // shares: where it is free, where it hits
  const int first = hits(of, 0, out->motion);
  if (first < 0 || hits(of, 1, out->motion) != !first) return 0;
  there[first] = 0;
  there[!first] = 1;
  for (int k = 0; k < STEPS; k++) {
    const double middle = (there[0] + there[1]) / 2;
    there[hits(of, middle, out->motion) == 1] = middle;
  }
  const double away = (LEAST + fabs(SPREAD * shapes_normal(rng))) / s->aside;
  const double sign = there[1] > there[0] ? 1 : -1;
  const double at = out->hits ? there[1] + sign * away : there[0] - sign * away;
  return hits(of, at, out->motion) == out->hits;
}

void EXPORT(trade_choose)(size_t set) {
  chosen = &sets[set];
  moving = &parts[chosen->moving];
  fixed = &parts[chosen->fixed];
  rng.state = 2026;
}
// Makes motions `from` to before `to` of the set that was chosen last, in order: they are always the same.
void EXPORT(trade_make)(size_t from, size_t to) {
  for (size_t i = from; i < to; i++) {
    sketch of;
    trials[i].hits = i % 2;
    do draw(&rng, chosen, &of);
    while (!nearly_touches(&rng, chosen, &of, &trials[i]));
  }
}

// ------------------------------------------------------------------------------------------- asking

// Asks at so many samples of motions `from` to before `to` whether the meshes come as near as so many metres.
void EXPORT(trade_ask_samples)(size_t samples, float near, size_t from, size_t to) {
  const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  uint16_t order[SAMPLER_MOST];
  order_of_visiting(samples, order);
  for (size_t i = from; i < to; i++) {
    sampler s;
    start_sampler(&s, trials[i].motion, 2, &origin, samples, order);
    said[i] = (uint8_t)sweep_discrete(trade_hierarchy(), moving->tree, fixed->tree, &s, near);
  }
}

// Asks the library about them: the network of a size, or, with NSVCD_MODEL_DEFAULT, the proof.
nsvcd_result EXPORT(trade_ask)(nsvcd_model model, size_t from, size_t to) {
  nsvcd_result result = NSVCD_OK;
  if (model) result = add_latents(moving);
  if (model && !result) result = add_latents(fixed);
  for (size_t i = from; i < to && !result; i++) {
    nsvcd_question question = make_question(trials[i].motion);
    if (model) {
      question.a.body = moving->latents;
      question.b.body = fixed->latents;
      question.method = NSVCD_METHOD_NETWORK;
      question.network.model = model;
    }
    result = nsvcd_sweep(&question, workspace, workspace_size, &answer);
    said[i] = answer.verdict != NSVCD_FREE;
  }
  return result;
}

// Of the motion in trade_motion: the first contact, or, with NSVCD_ASK_DISTANCE, where it is nearest.
nsvcd_result EXPORT(trade_look)(nsvcd_ask ask) {
  nsvcd_question question = make_question(motion);
  question.ask = ask;
  return nsvcd_sweep(&question, workspace, workspace_size, &answer);
}

nsvcd_pose *EXPORT(trade_motion)(void) {
  return motion;
}
const nsvcd_answer *EXPORT(trade_answer)(void) {
  return &answer;
}
const trial *EXPORT(trade_trials)(void) {
  return trials;
}
size_t EXPORT(trade_count)(void) {
  return COUNT;
}
const uint8_t *EXPORT(trade_said)(void) {
  return said;
}
// Of A (0) and of B (1).
const nsvcd_mesh *EXPORT(trade_mesh)(int is_fixed) {
  return is_fixed ? &fixed->mesh : &moving->mesh;
}
const char *EXPORT(trade_result_string)(nsvcd_result result) {
  return nsvcd_result_string(result);
}
