// game_watch.h - what looks at game.c from outside: holds its poses against the oracle, writes
// problem files, prints what a frame costs, draws. Included by it after `game` is declared.
#ifndef NSVCD_SCENERY_GAME_WATCH_H
#define NSVCD_SCENERY_GAME_WATCH_H

#include "draw.h"
#include "poses.h"

#define EACH 7  // every seventh way is written as a problem

typedef struct watch {
  oracle_mesh exact[THINGS + 1];  // by ids, once they are asked for
  nsvcd_pose trail[64];           // of the character
  size_t trail_count, ways, overlaps, held;
  int checks;
  const char *folder;
  FILE *problems;  // NULL: none are written
} watch;

// ------------------------------------------------------------------------------------------ meshes

static void make_meshes(shapes_mesh *s, int n) {
  level_props(s, n);
  shapes_cone(&s[NEEDLE], 0.006, 0, 0.2, 8);
  shapes_capsule(&s[WALKER], (double)CAPSULE_RADIUS, 2 * (double)CAPSULE_HALF, n / 2);
}

// Where a thing is; 0 if there is none of this id.
static int place_of(const game *g, size_t id, nsvcd_pose *pose) {
  nsvcd_world_body body;
  if (nsvcd_world_get(g->world, id, &body)) return 0;
  *pose = body.pose;
  return 1;
}

// Its triangles as the oracle has them; 0 if there is none of this id.
static int exact_of(const game *g, watch *w, size_t id, oracle_pose *at) {
  const shapes_mesh *s = &g->meshes[g->kinds[id]];
  oracle_mesh *exact = &w->exact[id];
  nsvcd_pose pose;
  if (!place_of(g, id, &pose)) return 0;
  if (!exact->triangles && !oracle_mesh_init(exact, s->positions, s->vertices, s->indices,
                                             s->triangles, (double)g->scales[id]))
    exit(REFUSED);
  *at = pose_widened(&pose);
  return 1;
}

// ---------------------------------------------------------------------------------------- checking

// Holds all poses against each other, by the oracle; `inside`: and asks what is inside of what.
static void check(const game *g, watch *w, int inside) {
  oracle_search search;
  oracle_pose at, there;
  for (size_t a = 1; a <= THINGS; a++) {
    if (!exact_of(g, w, a, &at)) continue;
    for (size_t b = 1; b < a; b++) {
      if (!exact_of(g, w, b, &there)) continue;
      oracle_search_begin(&search, &w->exact[a], &w->exact[b]);
      int bad = !(oracle_search_run(&search, &at, &there, 1e-4) > 0);
      bad |= inside && !bad &&
             (oracle_inside(&w->exact[a], &at, &w->exact[b], &there) > 0.5 ||
              oracle_inside(&w->exact[b], &there, &w->exact[a], &at) > 0.5);
      if (bad) complain("frame %zu: things %zu and %zu overlap", g->frame, a, b);
      w->overlaps += bad != 0;
      w->held++;
    }
  }
}

// ---------------------------------------------------------------------------------------- problems

static FILE *open_problems(const game *g, const char *folder) {
  char path[4096];
  for (size_t k = 0; k <= LEVEL; k++) {
    snprintf(path, sizeof path, "%s/mesh%zu.obj", folder, k);
    if (!shapes_write_obj(&g->meshes[k], path)) return NULL;
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

// Where a mover would be after a frame, if nothing were in its way.
static nsvcd_pose aim(const nsvcd_pose *at, const nsvcd_velocity *velocity) {
  oracle_pose pose = pose_widened(at);
  double turn[4] = {0, 0, 0, 1};
  double turned[4];
  for (int k = 0; k < 3; k++) {
    pose.position[k] += (double)(FRAME * velocity->linear[k]);
    turn[k] = (double)(0.5f * FRAME * velocity->angular[k]);
  }
  oracle_quat_mul(turn, pose.rotation, turned);
  oracle_quat_normalize(turned);
  memcpy(pose.rotation, turned, sizeof turned);
  return pose_rounded(&pose);
}

// Some of the ways that movers are about to go, each beside a thing that is near. The character, who
// is round, is no mesh.
static void write_problems(const game *g, watch *w) {
  static nsvcd_body_pair pairs[THINGS * THINGS];
  size_t count;
  if (nsvcd_world_pairs(g->world, 2 * FRAME, pairs, THINGS * THINGS, &count)) return;
  for (size_t k = 0; k < count; k++) {
    const size_t pair[2] = {pairs[k].a, pairs[k].b};
    if (g->kinds[pair[0]] == WALKER || g->kinds[pair[1]] == WALKER) continue;
    for (size_t n = 0; n < g->count; n++) {
      const nsvcd_world_mover *m = &g->movers[n];
      const size_t other = m->id == pair[0] ? pair[1] : pair[0];
      nsvcd_pose at, there;
      if ((m->id != pair[0] && m->id != pair[1]) || m->asleep || w->ways++ % EACH != 0) continue;
      if (!place_of(g, m->id, &at) || !place_of(g, other, &there)) continue;
      const nsvcd_pose end = aim(&at, &m->velocity);
      fprintf(w->problems, "problem f%zu.%zu %d %.9g %d %.9g 0 0 0 0 0 0 1 -1 nan 2 1\n", g->frame,
              w->ways, g->kinds[m->id], (double)g->scales[m->id], g->kinds[other],
              (double)g->scales[other]);
      write_pose(w->problems, &at);
      write_pose(w->problems, &end);
      write_pose(w->problems, &there);
    }
  }
}

// --------------------------------------------------------------------------------------- reporting

static int compare_doubles(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}

static void print_report(const game *g, const watch *w) {
  const double frames = (double)g->frames;
  size_t asleep = 0;
  double sum = 0;
  for (size_t i = 0; i < PROPS; i++) asleep += g->movers[i].asleep != 0;
  for (size_t k = 0; k < g->frames; k++) sum += g->frame_ms[k];
  qsort(g->frame_ms, g->frames, sizeof(double), compare_doubles);
  printf("%zu frames in a level of %zu triangles: %.1f questions and %.1f contacts each\n",
         g->frames, g->meshes[LEVEL].triangles, g->questions / frames, g->contacts / frames);
  printf("a frame: median %.2f, mean %.2f, worst %.2f ms; %.2f us a question\n",
         g->frame_ms[g->frames / 2], sum / frames, g->frame_ms[g->frames - 1],
         1e3 * sum / g->questions);
  printf("%zu of %d props asleep at the end; the character is past %zu of %zu stops\n", asleep,
         PROPS, g->stop, STOPS);
  if (w->checks) printf("overlaps: %zu of %zu pairs of poses\n", w->overlaps, w->held);
}

static void draw_things(const game *g, draw_list *list) {
  static const draw_colour *const colours[4] = {&draw_blue, &draw_orange, &draw_green, &draw_red};
  shapes_mesh coarse[SHAPES];
  memset(coarse, 0, sizeof coarse);
  make_meshes(coarse, 12);
  for (size_t id = 1; id <= THINGS; id++) {
    const int kind = g->kinds[id];
    nsvcd_pose at;
    if (!place_of(g, id, &at) || kind == LEVEL) continue;
    const oracle_pose pose = pose_widened(&at);
    draw_shape(list, &coarse[kind], (double)g->scales[id], &pose,
               kind == WALKER   ? &draw_china
               : kind == NEEDLE ? &draw_iron
                                : colours[id % 4]);
  }
  for (size_t k = 0; k < SHAPES; k++) shapes_free(&coarse[k]);
}

// Draws the way that the character has been.
static void draw_trail(const watch *w, draw_list *list) {
  shapes_mesh coarse;
  oracle_mesh mesh;
  memset(&coarse, 0, sizeof coarse);
  shapes_capsule(&coarse, (double)CAPSULE_RADIUS, 2 * (double)CAPSULE_HALF, 10);
  list->failed |= !oracle_mesh_init(&mesh, coarse.positions, coarse.vertices, coarse.indices,
                                    coarse.triangles, 1);
  for (size_t k = 0; k < w->trail_count && !list->failed; k++) {
    const oracle_pose pose = pose_widened(&w->trail[k]);
    draw_solid(list, &mesh, &pose, &draw_steel, 0.3);
  }
  if (!list->failed) oracle_mesh_free(&mesh);
  shapes_free(&coarse);
}

static int draw(const game *g, const watch *w) {
  static const draw_colour *const colours[3] = {&draw_cream, &draw_rock, &draw_steel};
  const draw_view view = {-1.15, 0.6, {0.4, 0, 0.3}, 125, 1060, 610};
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  draw_list list = {&view, NULL, 0, 0, 0};
  FILE *svg = draw_open("build/game.svg", 1100, 714, "A level at 60 Hz",
                        "50 props, a character and needles at 100 m/s: every move proven free");
  if (!svg) return 0;
  draw_panel(svg, 20, 84, &view);
  for (size_t k = 0; k < 3; k++) {
    shapes_mesh part = g->meshes[LEVEL];
    part.indices += 3 * g->parts[k];
    part.triangles = g->parts[k + 1] - g->parts[k];
    draw_shape(&list, &part, 1, &origin, colours[k]);
  }
  draw_things(g, &list);
  draw_trail(w, &list);
  draw_flush(svg, &list);
  draw_panel_end(svg, &view, "where things came to rest, and the way of the character");
  return draw_close(svg) && !list.failed;
}

// ------------------------------------------------------------------------------- what game.c calls

static int read_options(game *g, watch *w, int argc, char **argv, size_t *seed) {
  for (int i = 1; i < argc; i++) {
    const char *value = i + 1 < argc ? argv[i + 1] : "";
    if (strcmp(argv[i], "--check") == 0) {
      w->checks = 1;
      continue;
    }
    if (strcmp(argv[i], "--frames") == 0 && parse_count(value, 1, 100000, &g->frames))
      i++;
    else if (strcmp(argv[i], "--seed") == 0 && parse_count(value, 1, 100000, seed))
      i++;
    else if (strcmp(argv[i], "--problems") == 0 && value[0])
      w->folder = argv[++i];
    else
      return complain("%s %s: what is that?", argv[i], value);
  }
  return 1;
}

static int watch_begin(const game *g, watch *w) {
  if (w->folder) w->problems = open_problems(g, w->folder);
  return !w->folder || w->problems;
}

// Before each frame.
static void watch_frame(const game *g, watch *w) {
  const size_t walker = g->movers[CHARACTER].id;
  if (w->problems) write_problems(g, w);
  if (g->frame % 60 == 0 && w->trail_count < 64)
    (void)place_of(g, walker, &w->trail[w->trail_count++]);
  if (w->checks && g->frame > 0 && g->frame % 100 == 0) check(g, w, 0);
}

// After the last one. 0: something is wrong, and said.
static int watch_end(const game *g, watch *w) {
  if (w->checks) check(g, w, 1);
  print_report(g, w);
  const int is_lost = w->problems && ferror(w->problems);
  if (w->problems && (fclose(w->problems) != 0 || is_lost))
    return complain("the problems cannot be written");
  if (!draw(g, w)) return complain("build/game.svg cannot be written");
  printf("see build/game.svg\n");
  for (size_t id = 0; id <= THINGS; id++) oracle_mesh_free(&w->exact[id]);
  return w->overlaps == 0;
}

#endif
