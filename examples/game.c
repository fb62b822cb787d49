// game.c - a level at 60 Hz, without a screen: 50 props, most of them concave, fall into a pit and
// pile up, a character walks stairs, a ramp and hills, and needles are shot at 100 m/s. All of it
// is scenery/physics.h and walker.h: every move is proven free before it is made. Prints what a
// frame costs; draws build/game.svg.
//
//   build/game [--frames N] [--seed N] [--check] [--problems FOLDER]
//
// --check holds all poses against the oracle, now and then and at the end; --problems writes some
// of the questions as a problem file.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define PROGRAM "game"
#include "scenery/problem_file.h"
#include "scenery/draw.h"
#include "scenery/level.h"
#include "scenery/poses.h"
#include "scenery/walker.h"

#define PROPS 50
#define NEEDLES 10  // the most at a time
#define THINGS (PROPS + NEEDLES + 2)
enum { KINDS = 12, NEEDLE = KINDS, LEVEL, WALKER, SHAPES };

#define FRAME (1.0f / 60)
#define SIDE 16.0     // metres
#define GROUND 40000  // triangles
#define BUILT 100000  // triangles on it, about; together enough to make it a level by default
#define GAP 0.002f    // metres: things as near as this are in contact
#define BOLT 100.0f   // metres a second
#define CAPSULE_RADIUS 0.25f
#define CAPSULE_HALF 0.55f  // metres: half its axis
#define SPEED 1.6f          // metres a second, walking
#define EACH 7              // every seventh question is written as a problem

// The character's route: up the stairs, down the ramp, over the hills.
static const float route[][2] = {{-3.4f, -2}, {-0.2f, -2}, {3.9f, -2}, {3.4f, 1}, {2.4f, 2.6f}};
#define STOPS (sizeof route / sizeof *route)

typedef struct game {
  shapes_mesh shapes[SHAPES];
  physics_shape bodies[SHAPES];
  size_t parts[4];  // triangles of the level: ground, things on it, what is built
  physics_world *world;
  physics_walker walker;
  size_t stop;  // the stop of the route that it is going to
  size_t props[PROPS], needles[NEEDLES];
  oracle_mesh exact[THINGS];
  nsvcd_pose trail[64];
  size_t trail_count;
  shapes_rng rng;
  double *frame_ms;
  size_t frames, frame, asked, overlaps, held;
  int checks;
  FILE *problems;  // NULL: none are written
} game;

// ------------------------------------------------------------------------------------------ making

static void make_level(shapes_mesh *mesh, size_t *parts) {
  const int pitches = (int)(SIDE / 2);
  shapes_rng rng = {5};
  level_ground(mesh, SIDE, (uint32_t)sqrt(GROUND / 4.0));
  parts[1] = mesh->triangles;
  for (int n = 0; n < pitches * pitches; n++) {  // round about the place where all happens
    const size_t first = mesh->vertices;
    const double turn = shapes_uniform(&rng, 0, SHAPES_PI);
    const double q[4] = {0, 0, sin(0.5 * turn), cos(0.5 * turn)};
    const double x = 2 * (n % pitches) + 1 - SIDE / 2;
    const double y = 2 * (n / pitches) + 1 - SIDE / 2;
    if (fabs(x) < 6 && y > -4 && y < 4) continue;
    level_thing(mesh, shapes_pick(&rng, 6), BUILT / 40, &rng);
    shapes_place(mesh, first, q, x, y, level_height(x, y) - 0.05);
  }
  parts[2] = mesh->triangles;
  const size_t stairs = mesh->vertices;
  level_stairs(mesh, 1.4, 0.28, 0.17, 7);
  shapes_place(mesh, stairs, NULL, -3, -2, level_height(-3, -2));
  for (int k = 0; k < 4; k++) {  // a pit
    const size_t wall = mesh->vertices;
    shapes_box(mesh, k < 2 ? 2.4 : 0.15, k < 2 ? 0.15 : 2.55, 1, 8);
    shapes_place(mesh, wall, NULL, k < 2 ? 0 : 2.4 * k - 6, k < 2 ? 2.4 * k - 0.1 : 1.1, 0.1);
  }
  parts[3] = mesh->triangles;
}

// n: how fine round ones are. A capsule is no mesh, but round: one that fits into it is drawn, and
// held against the oracle.
static void make_props(shapes_mesh *s, int n) {
  shapes_mug(&s[0], 0.06, 0.13, 0.008, n);
  shapes_bowl(&s[1], 0.16, 0.09, 0.012, n);
  shapes_torus(&s[2], 0.12, 0.04, n, n / 2);
  shapes_box(&s[3], 0.24, 0.18, 0.2, 1);
  shapes_chair(&s[4], 0.24, 0.5, 0.03);
  shapes_bottle(&s[5], 0.06, 0.28, n);
  shapes_gear(&s[6], 0.14, 0.03, 0.06, 20);
  shapes_drawer(&s[7], 0.3, 0.2, 0.12, 0.015);
  shapes_knot(&s[8], 0.09, 0.03, 2 * n, n / 4);
  level_boulder(&s[9], 0.14, n / 2, 1);
  shapes_l_bracket(&s[10], 0.24, 0.3, 0.06, 0.12);
  shapes_slot(&s[11], 0.26, 0.2, 0.14, 0.1, 0.1);
  shapes_cone(&s[NEEDLE], 0.006, 0, 0.2, 8);
  shapes_capsule(&s[WALKER], (double)CAPSULE_RADIUS, 2 * (double)CAPSULE_HALF, n / 2);
}

static int make_shapes(game *g) {
  nsvcd_encode_options options;
  const float from[3] = {0, 0, -CAPSULE_HALF};
  const float to[3] = {0, 0, CAPSULE_HALF};
  memset(&options, 0, sizeof options);
  make_props(g->shapes, 64);
  make_level(&g->shapes[LEVEL], g->parts);
  for (size_t k = 0; k <= LEVEL; k++) {
    shapes_mesh *s = &g->shapes[k];
    options.patch_radius = k == LEVEL ? 0.1f : 0;
    if (s->failed || physics_encode(s->positions, s->vertices, s->indices, s->triangles, &options,
                                    k != LEVEL, &g->bodies[k]))
      return 0;
  }
  return !g->shapes[WALKER].failed &&
         nsvcd_encode_capsule(from, to, CAPSULE_RADIUS, NULL, &g->bodies[WALKER].body) == NSVCD_OK;
}

static int keep_exact(game *g, size_t thing) {
  const physics_thing *t = &g->world->things[thing];
  const shapes_mesh *s = &g->shapes[t->shape];
  oracle_mesh_free(&g->exact[thing]);
  return oracle_mesh_init(&g->exact[thing], s->positions, s->vertices, s->indices, s->triangles,
                          (double)t->scale);
}

static nsvcd_pose pose_at(float x, float y, float z) {
  nsvcd_pose pose;
  memset(&pose, 0, sizeof pose);
  pose.position[0] = x;
  pose.position[1] = y;
  pose.position[2] = z;
  pose.rotation[3] = 1;
  return pose;
}

// Makes the level, the character, and props in the air, in layers.
static int fill_world(game *g) {
  static const float scales[4] = {0.8f, 1, 1.2f, 1.5f};
  const nsvcd_pose origin = pose_at(0, 0, 0);
  const nsvcd_pose start = pose_at(-5, -2, 1.5f);
  physics_world *w = g->world;
  if (!keep_exact(g, physics_add(w, LEVEL, 1, 0, &origin))) return 0;
  g->walker.thing = physics_add(w, WALKER, 1, 0, &start);
  g->walker.step = 0.25f;
  g->walker.slope = 0.7f;
  g->walker.strength = 40;
  if (!keep_exact(g, g->walker.thing)) return 0;
  for (size_t i = 0; i < PROPS; i++) {
    double q[4];
    const float x = -0.7f + 0.7f * (float)(i % 3);
    const float y = 0.4f + 0.7f * (float)(i / 3 % 3);
    const float scale = scales[shapes_pick(&g->rng, 4)];
    nsvcd_pose pose = pose_at(x, y, 1 + 0.85f * (float)(i / 9));
    shapes_quaternion(&g->rng, q);
    for (int k = 0; k < 4; k++) pose.rotation[k] = (float)q[k];
    const size_t thing = physics_add(w, i % KINDS, scale, 5 * scale * scale * scale, &pose);
    if (thing == PHYSICS_NOTHING || !keep_exact(g, thing)) return 0;
    g->props[i] = thing;
    w->things[thing].velocity.x = (float)shapes_uniform(&g->rng, -0.5, 0.5);
    w->things[thing].spin.y = (float)shapes_uniform(&g->rng, -3, 3);
  }
  for (size_t i = 0; i < NEEDLES; i++) g->needles[i] = PHYSICS_NOTHING;
  return 1;
}

// ------------------------------------------------------------------------------------------ asking

static void write_pose(FILE *file, const nsvcd_pose *pose, const float *offset) {
  for (int k = 0; k < 3; k++) fprintf(file, "%.9g ", (double)(pose->position[k] + offset[k]));
  for (int k = 0; k < 4; k++)
    fprintf(file, "%.9g%c", (double)pose->rotation[k], k < 3 ? ' ' : '\n');
}

static FILE *open_problems(const game *g, const char *folder) {
  char path[4096];
  for (size_t k = 0; k <= LEVEL; k++) {
    snprintf(path, sizeof path, "%s/mesh%zu.obj", folder, k);
    if (!shapes_write_obj(&g->shapes[k], path)) return NULL;
  }
  snprintf(path, sizeof path, "%s/game.txt", folder);
  FILE *file = fopen(path, "w");
  if (!file) return NULL;
  fprintf(file, "nsvcd-problems 1\n");
  for (size_t k = 0; k <= LEVEL; k++) fprintf(file, "mesh %zu mesh%zu.obj\n", k, k);
  return file;
}

// One of the questions, lifted as its answer says: what is left of the question is a clearance of
// GAP. What is asked about the character, who is round, is no problem of meshes.
static void write_problem(const game *g, const nsvcd_question *q, const nsvcd_answer *answer) {
  const float none[3] = {0, 0, 0};
  size_t a = 0;
  size_t b = 0;
  while (g->bodies[a].body != q->a.body) a++;
  while (g->bodies[b].body != q->b.body) b++;
  if (a > LEVEL || b > LEVEL || q->clearance < GAP) return;
  fprintf(g->problems, "problem f%zu.%zu.%d %zu %.9g %zu %.9g 0 0 0 0 0 0 1 -1 nan %zu %zu\n",
          g->frame, g->asked, answer->verdict != NSVCD_FREE, a, (double)q->a.scale, b,
          (double)q->b.scale, q->a.count, q->b.count);
  for (size_t i = 0; i < q->a.count; i++) write_pose(g->problems, &q->a.poses[i], answer->push_out);
  for (size_t i = 0; i < q->b.count; i++) write_pose(g->problems, &q->b.poses[i], none);
}

// A physics_ask that looks at the clock.
static nsvcd_result ask(void *user, const nsvcd_question *questions, size_t count, void *workspace,
                        size_t size, nsvcd_answer *answers) {
  game *g = (game *)user;
  const double start = seconds();
  const nsvcd_result result = nsvcd_sweep_batch(questions, count, workspace, size, answers);
  g->frame_ms[g->frame] += 1e3 * (seconds() - start);
  for (size_t k = 0; k < count && g->problems && !result; k++)
    if (g->asked++ % EACH == 0) write_problem(g, &questions[k], &answers[k]);
  return result;
}

// ----------------------------------------------------------------------------------------- playing

static void walk(game *g) {
  const float *at = g->world->things[g->walker.thing].pose.position;
  float x = 0;
  float y = 0;
  if (g->stop < STOPS) {
    x = route[g->stop][0] - at[0];
    y = route[g->stop][1] - at[1];
    const float length = sqrtf(x * x + y * y);
    if (length < 0.1f) g->stop++;
    x *= SPEED / fmaxf(length, 0.1f);
    y *= SPEED / fmaxf(length, 0.1f);
  }
  physics_walk(g->world, &g->walker, x, y, FRAME);
  if (g->frame % 60 == 0 && g->trail_count < 64)
    g->trail[g->trail_count++] = g->world->things[g->walker.thing].pose;
}

// Shoots a needle from somewhere above at one of the props. The oldest needle is gone then.
static int shoot(game *g) {
  static size_t next;
  const physics_thing *prop = &g->world->things[g->props[shapes_pick(&g->rng, PROPS)]];
  nsvcd_pose pose = pose_at((float)shapes_uniform(&g->rng, -3, 3), 4, 3.5f);
  size_t *needle = &g->needles[next++ % NEEDLES];
  physics_vec way = physics_minus(physics_from(prop->pose.position), physics_from(pose.position));
  way = physics_times(1 / physics_length(way), way);
  // its point, at the end of its z, goes ahead
  const float w = sqrtf(0.5f * (1 + way.z));
  pose.rotation[0] = -0.5f * way.y / w;
  pose.rotation[1] = 0.5f * way.x / w;
  pose.rotation[3] = w;
  if (*needle != PHYSICS_NOTHING) physics_remove(g->world, *needle);
  *needle = physics_add(g->world, NEEDLE, 1, 0.05f, &pose);
  if (*needle == PHYSICS_NOTHING) return 1;
  g->world->things[*needle].velocity = physics_times(BOLT, way);
  return keep_exact(g, *needle);
}

// Holds all poses against each other, by the oracle; `inside`: and asks what is inside of what.
static void check(game *g, int inside) {
  const physics_world *w = g->world;
  oracle_search search;
  for (size_t i = 0; i < w->count; i++) {
    const physics_thing *a = &w->things[i];
    for (size_t k = 0; k < i; k++) {
      const physics_thing *b = &w->things[k];
      if (a->shape == PHYSICS_NOTHING || b->shape == PHYSICS_NOTHING) continue;
      const oracle_pose pose_a = pose_widened(&a->pose);
      const oracle_pose pose_b = pose_widened(&b->pose);
      oracle_search_begin(&search, &g->exact[i], &g->exact[k]);
      int bad = !(oracle_search_run(&search, &pose_a, &pose_b, 1e-4) > 0);
      bad |= inside && !bad && oracle_inside(&g->exact[i], &pose_a, &g->exact[k], &pose_b) > 0.5;
      if (bad) complain("frame %zu: things %zu and %zu overlap", g->frame, i, k);
      g->overlaps += bad != 0;
      g->held++;
    }
  }
}

static int play(game *g) {
  for (g->frame = 0; g->frame < g->frames; g->frame++) {
    if (g->frame % 60 == 59 && !shoot(g)) return complain("out of memory");
    walk(g);
    const nsvcd_result result = physics_step(g->world, FRAME);
    if (result) return complain("frame %zu: %s", g->frame, nsvcd_result_string(result));
    if (g->checks && g->frame % 100 == 99) check(g, 0);
  }
  if (g->checks) check(g, 1);
  return 1;
}

// --------------------------------------------------------------------------------------- reporting

static int compare_doubles(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}

static void print_report(game *g) {
  const physics_counts *c = &g->world->counts;
  const double frames = (double)g->frames;
  size_t asleep = 0;
  double sum = 0;
  for (size_t i = 0; i < PROPS; i++) asleep += g->world->things[g->props[i]].asleep != 0;
  for (size_t k = 0; k < g->frames; k++) sum += g->frame_ms[k];
  qsort(g->frame_ms, g->frames, sizeof(double), compare_doubles);
  printf(
      "%zu frames in a level of %zu triangles: %.1f questions each; %zu contacts, %zu undecided, "
      "%zu stopped where they were\n",
      g->frames, g->shapes[LEVEL].triangles, (double)c->questions / frames, c->contacts,
      c->undecided, c->pressed);
  printf("asking about them: median %.2f, mean %.2f, worst %.2f ms; %.2f us a question\n",
         g->frame_ms[g->frames / 2], sum / frames, g->frame_ms[g->frames - 1],
         1e3 * sum / (double)c->questions);
  printf("%zu of %d props asleep at the end; the character is past %zu of %zu stops\n", asleep,
         PROPS, g->stop, STOPS);
  if (g->checks) printf("overlaps: %zu of %zu pairs of poses\n", g->overlaps, g->held);
}

static void draw_props(const game *g, draw_list *list) {
  static const draw_colour *const colours[4] = {&draw_blue, &draw_orange, &draw_green, &draw_red};
  shapes_mesh coarse[SHAPES];
  memset(coarse, 0, sizeof coarse);
  make_props(coarse, 12);
  for (size_t i = 0; i < g->world->count; i++) {
    const physics_thing *t = &g->world->things[i];
    if (t->shape == PHYSICS_NOTHING || t->shape == LEVEL) continue;
    oracle_pose pose = pose_widened(&t->pose);
    if (t->shape < KINDS) {  // about the same origin
      const shapes_mesh *fine = &g->shapes[t->shape];
      shapes_mesh *mesh = &coarse[t->shape];
      double low[2][3], high[2][3];
      shapes_bounds(fine, low[0], high[0]);
      shapes_bounds(mesh, low[1], high[1]);
      shapes_place(mesh, 0, NULL, low[0][0] - low[1][0], low[0][1] - low[1][1],
                   low[0][2] - low[1][2]);
    }
    draw_shape(list, &coarse[t->shape], (double)t->scale, &pose,
               t->shape == WALKER   ? &draw_china
               : t->shape == NEEDLE ? &draw_iron
                                    : colours[i % 4]);
  }
  for (size_t k = 0; k < SHAPES; k++) shapes_free(&coarse[k]);
}

// Draws the way that the character has been.
static void draw_trail(const game *g, draw_list *list) {
  shapes_mesh coarse;
  oracle_mesh mesh;
  memset(&coarse, 0, sizeof coarse);
  shapes_capsule(&coarse, (double)CAPSULE_RADIUS, 2 * (double)CAPSULE_HALF, 10);
  list->failed |= !oracle_mesh_init(&mesh, coarse.positions, coarse.vertices, coarse.indices,
                                    coarse.triangles, 1);
  for (size_t k = 0; k < g->trail_count && !list->failed; k++) {
    const oracle_pose pose = pose_widened(&g->trail[k]);
    draw_solid(list, &mesh, &pose, &draw_steel, 0.3);
  }
  if (!list->failed) oracle_mesh_free(&mesh);
  shapes_free(&coarse);
}

static int draw(const game *g) {
  static const draw_colour *const colours[3] = {&draw_cream, &draw_rock, &draw_steel};
  const draw_view view = {-1.15, 0.6, {0.4, 0, 0.3}, 125, 1060, 610};
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  draw_list list = {&view, NULL, 0, 0, 0};
  FILE *svg = draw_open("build/game.svg", 1100, 714, "A level at 60 Hz",
                        "50 props, a character and needles at 100 m/s: every move proven free");
  if (!svg) return 0;
  draw_panel(svg, 20, 84, &view);
  for (size_t k = 0; k < 3; k++) {
    shapes_mesh part = g->shapes[LEVEL];
    part.indices += 3 * g->parts[k];
    part.triangles = g->parts[k + 1] - g->parts[k];
    draw_shape(&list, &part, 1, &origin, colours[k]);
  }
  draw_props(g, &list);
  draw_trail(g, &list);
  draw_flush(svg, &list);
  draw_panel_end(svg, &view, "where things came to rest, and the way of the character");
  return draw_close(svg) && !list.failed;
}

// -------------------------------------------------------------------------------------------- main

static int read_options(game *g, int argc, char **argv, size_t *seed, const char **folder) {
  for (int i = 1; i < argc; i++) {
    const char *value = i + 1 < argc ? argv[i + 1] : "";
    if (strcmp(argv[i], "--check") == 0) {
      g->checks = 1;
      continue;
    }
    if (strcmp(argv[i], "--frames") == 0 && parse_count(value, 1, 100000, &g->frames))
      i++;
    else if (strcmp(argv[i], "--seed") == 0 && parse_count(value, 1, 100000, seed))
      i++;
    else if (strcmp(argv[i], "--problems") == 0 && value[0])
      *folder = argv[++i];
    else
      return complain("%s %s: what is that?", argv[i], value);
  }
  return 1;
}

int main(int argc, char **argv) {
  static game g;
  size_t seed = 2026;
  const char *folder = NULL;
  g.frames = 600;
  if (!read_options(&g, argc, argv, &seed, &folder)) return USAGE;
  if (!make_shapes(&g)) return complain("out of memory"), REFUSED;
  if (folder) g.problems = open_problems(&g, folder);
  if (folder && !g.problems)
    return complain("%s: problems cannot be written there", folder), REFUSED;
  g.frame_ms = (double *)allocate(g.frames * sizeof(double));
  for (size_t k = 0; k < g.frames; k++) g.frame_ms[k] = 0;
  g.rng.state = seed;
  g.world = physics_new(g.bodies, THINGS);
  if (!g.world) return complain("out of memory"), REFUSED;
  g.world->ask = ask;
  g.world->user = &g;
  g.world->clearance = GAP;
  if (!fill_world(&g)) return complain("no room for the props, or no memory"), REFUSED;
  const int good = play(&g);
  if (good) print_report(&g);
  const int is_lost = g.problems && ferror(g.problems);
  if (g.problems && (fclose(g.problems) != 0 || is_lost))
    return complain("the problems cannot be written"), REFUSED;
  if (good && !draw(&g)) return complain("build/game.svg cannot be written"), REFUSED;
  if (good) printf("see build/game.svg\n");
  for (size_t k = 0; k < SHAPES; k++) {
    nsvcd_body_free(g.bodies[k].body, NULL);
    shapes_free(&g.shapes[k]);
  }
  for (size_t i = 0; i < THINGS; i++) oracle_mesh_free(&g.exact[i]);
  free(g.world);
  free(g.frame_ms);
  return good && g.overlaps == 0 ? DONE : REFUSED;
}
