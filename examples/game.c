// game.c - a level at 60 Hz, without a screen: 50 props, most of them concave, fall into a pit and
// pile up, a character walks stairs, a ramp and hills, and needles are shot at 100 m/s. All are
// bodies of an nsvcd_world (scenery/props.h), and every move is proven free before it is made.
// Prints what a frame costs; draws build/game.svg.
//
//   build/game [--frames N] [--seed N] [--check] [--problems FOLDER]
//
// --check holds all poses against the oracle, now and then and at the end; --problems writes some
// of the ways that things are about to go as a problem file.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../extras/neuralsvcd_world.h"
#define PROGRAM "game"
#include "scenery/problem_file.h"
#include "scenery/draw.h"
#include "scenery/level.h"
#include "scenery/poses.h"
#include "scenery/props.h"

#define PROPS 50
#define NEEDLES 10  // the most at a time
#define THINGS (PROPS + NEEDLES + 2)
enum { NEEDLE = LEVEL_PROPS, LEVEL, WALKER, SHAPES };

#define FRAME (1.0f / 60)
#define GAP 0.002f   // metres: things never come nearer to each other
#define BOLT 100.0f  // metres a second
#define CAPSULE_RADIUS 0.25f
#define CAPSULE_HALF 0.55f  // metres: half its axis
#define SPEED 1.6f          // metres a second, walking
#define EACH 7              // every seventh way is written as a problem

// The character's route: up the stairs, down the ramp, over the hills.
static const float route[][2] = {{-3.4f, -2}, {-0.2f, -2}, {3.9f, -2}, {3.4f, 1}, {2.4f, 2.6f}};
#define STOPS (sizeof route / sizeof *route)

typedef struct game {
  shapes_mesh shapes[SHAPES];
  props_shape bodies[SHAPES];
  size_t parts[4];  // triangles of the level: ground, things on it, what is built
  props_world *world;
  size_t props[PROPS], needles[NEEDLES], walker;  // ids
  size_t stop;                                    // the stop of the route that it is going to
  oracle_mesh exact[THINGS + 1];                  // by ids
  nsvcd_pose trail[64];
  size_t trail_count;
  shapes_rng rng;
  double *frame_ms;
  size_t frames, frame, ways, overlaps, held;
  int checks;
  FILE *problems;  // NULL: none are written
} game;

// ------------------------------------------------------------------------------------------ making

// A capsule is no mesh, but round: one that fits into it is drawn, and held against the oracle.
static void make_meshes(shapes_mesh *s, int n) {
  level_props(s, n);
  shapes_cone(&s[NEEDLE], 0.006, 0, 0.2, 8);
  shapes_capsule(&s[WALKER], (double)CAPSULE_RADIUS, 2 * (double)CAPSULE_HALF, n / 2);
}

static int make_shapes(game *g) {
  nsvcd_encode_options options;
  const float from[3] = {0, 0, -CAPSULE_HALF};
  const float to[3] = {0, 0, CAPSULE_HALF};
  memset(&options, 0, sizeof options);
  make_meshes(g->shapes, 64);
  level_with_pit(&g->shapes[LEVEL], g->parts);
  for (size_t k = 0; k <= LEVEL; k++) {
    options.patch_radius = k == LEVEL ? 0.1f : 0;
    if (props_encode(&g->shapes[k], &options, k != LEVEL, &g->bodies[k])) return 0;
  }
  return !g->shapes[WALKER].failed &&
         nsvcd_encode_capsule(from, to, CAPSULE_RADIUS, NULL, &g->bodies[WALKER].body) == NSVCD_OK;
}

// Puts a thing there, and keeps its triangles for the oracle. NSVCD_NOBODY: there is no room.
static size_t put(game *g, int kind, float scale, float mass, const nsvcd_pose *pose) {
  const size_t id = props_add(g->world, &g->bodies[kind], kind, scale, mass, pose);
  const shapes_mesh *s = &g->shapes[kind];
  oracle_mesh_free(&g->exact[id]);
  const int is_kept = oracle_mesh_init(&g->exact[id], s->positions, s->vertices, s->indices,
                                       s->triangles, (double)scale);
  return is_kept ? id : NSVCD_NOBODY;
}

static nsvcd_pose pose_at(float x, float y, float z) {
  const nsvcd_pose pose = {{x, y, z}, {0, 0, 0, 1}};
  return pose;
}

// Makes the level, the character, and props in the air, in layers.
static int fill_world(game *g) {
  static const float scales[4] = {0.8f, 1, 1.2f, 1.5f};
  const nsvcd_pose origin = pose_at(0, 0, 0);
  const nsvcd_pose start = pose_at(-5, -2, 1.5f);
  if (!put(g, LEVEL, 1, 0, &origin)) return 0;
  g->walker = put(g, WALKER, 1, 40, &start);
  if (!g->walker) return 0;
  props_make_walker(&g->world->things[g->walker], 0.25f);
  for (size_t i = 0; i < PROPS; i++) {
    double q[4];
    const float scale = scales[shapes_pick(&g->rng, 4)];
    nsvcd_pose pose = pose_at(-0.7f + 0.7f * (float)(i % 3), 0.4f + 0.7f * (float)(i / 3 % 3),
                              1 + 0.85f * (float)(i / 9));
    shapes_quaternion(&g->rng, q);
    for (int k = 0; k < 4; k++) pose.rotation[k] = (float)q[k];
    g->props[i] = put(g, (int)i % LEVEL_PROPS, scale, 5 * scale * scale * scale, &pose);
    if (!g->props[i]) return 0;
    nsvcd_velocity *velocity = &g->world->things[g->props[i]].velocity;
    velocity->linear[0] = (float)shapes_uniform(&g->rng, -0.5, 0.5);
    velocity->angular[1] = (float)shapes_uniform(&g->rng, -3, 3);
  }
  return 1;
}

// ---------------------------------------------------------------------------------------- checking

// Holds all poses against each other, by the oracle; `inside`: and asks what is inside of what.
static void check(game *g, int inside) {
  const props_world *w = g->world;
  oracle_search search;
  for (size_t i = 0; i < w->count; i++) {
    const size_t a = w->order[i];
    const oracle_pose pose_a = pose_widened(&w->things[a].pose);
    for (size_t k = 0; k < i; k++) {
      const size_t b = w->order[k];
      const oracle_pose pose_b = pose_widened(&w->things[b].pose);
      oracle_search_begin(&search, &g->exact[a], &g->exact[b]);
      int bad = !(oracle_search_run(&search, &pose_a, &pose_b, 1e-4) > 0);
      bad |= inside && !bad && oracle_inside(&g->exact[a], &pose_a, &g->exact[b], &pose_b) > 0.5;
      if (bad) complain("frame %zu: things %zu and %zu overlap", g->frame, a, b);
      g->overlaps += bad != 0;
      g->held++;
    }
  }
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

static void write_pose(FILE *file, const nsvcd_pose *pose) {
  for (int k = 0; k < 3; k++) fprintf(file, "%.9g ", (double)pose->position[k]);
  for (int k = 0; k < 4; k++)
    fprintf(file, "%.9g%c", (double)pose->rotation[k], k < 3 ? ' ' : '\n');
}

// Where a thing would be after a frame, if nothing were in its way.
static nsvcd_pose aim(const props_thing *t) {
  oracle_pose pose = pose_widened(&t->pose);
  double turn[4] = {0, 0, 0, 1};
  double turned[4];
  for (int k = 0; k < 3; k++) {
    pose.position[k] += (double)(FRAME * t->velocity.linear[k]);
    turn[k] = (double)(0.5f * FRAME * t->velocity.angular[k]);
  }
  oracle_quat_mul(turn, pose.rotation, turned);
  oracle_quat_normalize(turned);
  memcpy(pose.rotation, turned, sizeof turned);
  return pose_rounded(&pose);
}

// Some of the ways that things are about to go, each beside a thing that is near. The character, who
// is round, is no mesh.
static void write_problems(game *g) {
  static nsvcd_body_pair pairs[THINGS * THINGS];
  const props_world *w = g->world;
  size_t count;
  if (nsvcd_world_pairs(w->world, 2 * FRAME, pairs, THINGS * THINGS, &count)) return;
  for (size_t k = 0; k < count; k++) {
    const props_thing *pair[2] = {&w->things[pairs[k].a], &w->things[pairs[k].b]};
    const int moves = props_speed(pair[0]) > props_speed(pair[1]) ? 0 : 1;
    const props_thing *a = pair[moves];
    const props_thing *b = pair[!moves];
    if (a->kind == WALKER || b->kind == WALKER || !(props_speed(a) > 0)) continue;
    if (g->ways++ % EACH != 0) continue;
    const nsvcd_pose end = aim(a);
    fprintf(g->problems, "problem f%zu.%zu %d %.9g %d %.9g 0 0 0 0 0 0 1 -1 nan 2 1\n", g->frame,
            g->ways, a->kind, (double)a->scale, b->kind, (double)b->scale);
    write_pose(g->problems, &a->pose);
    write_pose(g->problems, &end);
    write_pose(g->problems, &b->pose);
  }
}

// ----------------------------------------------------------------------------------------- playing

static void walk(game *g) {
  props_thing *walker = &g->world->things[g->walker];
  float *velocity = walker->velocity.linear;
  velocity[0] = velocity[1] = 0;
  if (g->stop < STOPS) {
    const float x = route[g->stop][0] - walker->pose.position[0];
    const float y = route[g->stop][1] - walker->pose.position[1];
    const float length = sqrtf(x * x + y * y);
    if (length < 0.1f) g->stop++;
    velocity[0] = x * SPEED / fmaxf(length, 0.1f);
    velocity[1] = y * SPEED / fmaxf(length, 0.1f);
  }
  if (g->frame % 60 == 0 && g->trail_count < 64) g->trail[g->trail_count++] = walker->pose;
}

// Shoots a needle from somewhere above at one of the props. The oldest needle is gone then.
static void shoot(game *g) {
  const props_thing *prop = &g->world->things[g->props[shapes_pick(&g->rng, PROPS)]];
  nsvcd_pose pose = pose_at((float)shapes_uniform(&g->rng, -3, 3), 4, 3.5f);
  size_t *needle = &g->needles[g->frame / 60 % NEEDLES];
  float way[3], square = 0;
  for (int k = 0; k < 3; k++) {
    way[k] = prop->pose.position[k] - pose.position[k];
    square += way[k] * way[k];
  }
  for (int k = 0; k < 3; k++) way[k] /= sqrtf(square);
  // its point, at the end of its z, goes ahead
  const float w = sqrtf(0.5f * (1 + way[2]));
  pose.rotation[0] = -0.5f * way[1] / w;
  pose.rotation[1] = 0.5f * way[0] / w;
  pose.rotation[3] = w;
  props_remove(g->world, *needle);
  *needle = put(g, NEEDLE, 1, 0.05f, &pose);
  for (int k = 0; k < 3; k++) g->world->things[*needle].velocity.linear[k] = BOLT * way[k];
}

static int play(game *g) {
  for (g->frame = 0; g->frame < g->frames; g->frame++) {
    if (g->frame % 60 == 59) shoot(g);
    walk(g);
    if (g->problems) write_problems(g);
    const double start = seconds();
    const nsvcd_result result = props_step(g->world, FRAME);
    g->frame_ms[g->frame] = 1e3 * (seconds() - start);
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
  const props_world *w = g->world;
  const double frames = (double)g->frames;
  size_t asleep = 0;
  double sum = 0;
  for (size_t i = 0; i < PROPS; i++) asleep += w->things[g->props[i]].asleep != 0;
  for (size_t k = 0; k < g->frames; k++) sum += g->frame_ms[k];
  qsort(g->frame_ms, g->frames, sizeof(double), compare_doubles);
  printf("%zu frames in a level of %zu triangles: %.1f questions and %.1f contacts each\n",
         g->frames, g->shapes[LEVEL].triangles, (double)w->counts[0] / frames,
         (double)w->counts[1] / frames);
  printf("a frame: median %.2f, mean %.2f, worst %.2f ms; %.2f us a question\n",
         g->frame_ms[g->frames / 2], sum / frames, g->frame_ms[g->frames - 1],
         1e3 * sum / (double)w->counts[0]);
  printf("%zu of %d props asleep at the end; the character is past %zu of %zu stops\n", asleep,
         PROPS, g->stop, STOPS);
  if (g->checks) printf("overlaps: %zu of %zu pairs of poses\n", g->overlaps, g->held);
}

static void draw_props(const game *g, draw_list *list) {
  static const draw_colour *const colours[4] = {&draw_blue, &draw_orange, &draw_green, &draw_red};
  shapes_mesh coarse[SHAPES];
  memset(coarse, 0, sizeof coarse);
  make_meshes(coarse, 12);
  for (size_t i = 0; i < g->world->count; i++) {
    const props_thing *t = &g->world->things[g->world->order[i]];
    if (t->kind == LEVEL) continue;
    const oracle_pose pose = pose_widened(&t->pose);
    if (t->kind < LEVEL) {  // about the same origin
      shapes_mesh *mesh = &coarse[t->kind];
      double low[2][3], high[2][3];
      shapes_bounds(&g->shapes[t->kind], low[0], high[0]);
      shapes_bounds(mesh, low[1], high[1]);
      shapes_place(mesh, 0, NULL, low[0][0] - low[1][0], low[0][1] - low[1][1],
                   low[0][2] - low[1][2]);
    }
    draw_shape(list, &coarse[t->kind], (double)t->scale, &pose,
               t->kind == WALKER   ? &draw_china
               : t->kind == NEEDLE ? &draw_iron
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
  g.world = props_new(THINGS);
  if (!g.world) return complain("out of memory"), REFUSED;
  g.world->gap = GAP;
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
  for (size_t i = 0; i <= THINGS; i++) oracle_mesh_free(&g.exact[i]);
  free(g.world);
  free(g.frame_ms);
  return good && g.overlaps == 0 ? DONE : REFUSED;
}
