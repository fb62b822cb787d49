// problems.c - writes labelled problem files (examples/FORMATS.md), exact by scenery/oracle.h. See `problems`
// without arguments.
//
// What sets there are: the table `sets` below. How a problem comes about (the paper's appendix B,
// conditioned on the boundary; all sets but `inside` and `far`):
//   1. two meshes, random sizes; a smooth random motion of one; the other placed at random within
//      reach of it;
//   2. if they touch or one contains the other, the fixed body marches in a random direction to the
//      first place where they do not, which may well be a concavity; restart if there is none;
//   3. delta, the shortest vector between the swept and the fixed surface, by the oracle. Moved
//      along delta by its length, the fixed body just touches the motion, and nothing else touches:
//      separation is 1-Lipschitz in the offset. Verified: 0.1 mm short of it the bodies are free and
//      less than 0.3 mm apart, else rejected;
//   4. the fixed body moves on by eps ~ N(0, sigma^2) along delta (positive: deeper), and the
//      oracle relabels;
//   5. labels within 0.1 mm of contact are thrown away; classes are balanced by rejection: eps is
//      redrawn, at most four times, then the pair is dropped.
// The millimetres above are for bodies of some 0.1 m; `tiny` and `huge` scale them with everything
// else. MARGIN: the least separation if free. If colliding: minus the depth, the shortest way back
// along delta (against the sign of eps) after which the motion is free, found by eight steps and
// bisection; at most |eps|. It is an upper bound of the true penetration depth, since another
// direction may be shorter.
// Set `inside`: one body wholly inside a solid (label 1, nan), against controls in cavities of
// shells and cups (label 0). Set `far`: label 0, nothing else is asked of it. Set `offset`: the
// motion is rounded to float32 before anything is measured and the fixed pose before it is
// labelled, since a reader of floats sees nothing finer than 1 mm there; labels and free margins
// hold for the rounded poses, depths may be off by that rounding.
// Set `rest`: a body stands, slides, is set down or lifted at a stated gap above or below (pressed
// in) the flat surface of a fixed one, in turn over gaps, motions and labels. The margin is the
// oracle's if free. If colliding it is minus the depth by which the body was pressed in: raised by
// 0.1 mm less it still collides, by 0.2 mm more it is free, by the oracle. nan where no surfaces
// meet: wholly inside.
// Set `nested`: one body has two or three parts far from each other. Label 1, nan: exactly one of
// them is inside the other body (a solid, or the wall of a closed shell), the rest are outside,
// nothing touches. Label 0: one is in the shell's cavity, or by the solid.
// Set `same`: steps 2 to 4 from nearly the same pose, and that pose itself. There the margin is
// minus the way out along the direction of the march, by the eight steps and bisection.
// Sets `soup` and `one`: the label says whether surfaces touch. Where a body might be said to be
// inside (winding number above 0.25), the problem is thrown away: such meshes have no inside.
#define _XOPEN_SOURCE 700
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>

#include "../../examples/scenery/shapes.h"
#include "../../examples/scenery/oracle.h"
#include "set_shapes.h"

// of the oracle, metres; this and the next three are multiplied by the set's unit
#define TOLERANCE 5e-5
#define UNDECIDED 1e-4  // labels nearer to contact than this are thrown away
#define TOUCHING 3e-4   // just short of contact, the bodies are nearer than this
#define CLEARANCE 1e-3  // of what is inside
#define MAX_SAMPLES 1025

// -------------------------------------------------------------------------------------------- sets

typedef enum family {  // of procedural meshes; from RESTING on: set_shapes.h
  NONE,
  SOLIDS,
  HOLLOWS,
  SHELLS,
  CLOSED_SHELLS,
  SHEETS,
  RESTING,
  FLOORS,
  GROUPS,
  HOSTS,
  NEEDLES,
  SOUP,
  TRIANGLES
} family;

static const char *const family_names[] = {"",       "solid",   "hollow",  "shell", "shell",
                                           "sheet",  "resting", "floor",   "group", "host",
                                           "needle", "soup",    "triangle"};

typedef enum placing {
  ACROSS,      // bounds of the fixed body overlap those of the motion
  IN_BOUNDS,   // the motion starts within the bounds of the fixed body, and passes through them
  IN_CAVITY,   // the motion stays in the cavity of the fixed body, unless it collides
  ON_SURFACE,  // the motion passes near a random place of the fixed body's surface
  CONTAINED,   // one body inside the other (`inside`)
  APART,       // a gap of at least the extent of the larger body, over the whole motion
  ON_FLOOR,    // on the flat surface of the fixed body (`rest`)
  PARTLY_IN,   // one part of one body inside the other (`nested`)
  ALIKE        // the same mesh twice, at nearly the same pose or just out of it (`same`)
} placing;

typedef enum special {
  PLAIN,
  PATH_IN_EXTENTS,  // the path counts extents of the moving body
  HALF_SINGLE,      // every other motion is a single pose
  FAR_FROM_ORIGIN,  // the scene is ORIGIN_DISTANCE away, in poses of float32
  SURFACES_ONLY,    // the meshes have no inside
  HALF_TINY         // half of the motions are at most 1 mm and 1 degree
} special;

#define ORIGIN_DISTANCE 1e4

typedef struct set_info {
  const char *name;
  placing placing;
  special special;
  family moving_family;  // unless --meshes names a folder
  family fixed_family;   // NONE: the fixed body is drawn from the meshes of the moving one
  size_t fixed_meshes;   // how many of fixed_family
  int tries;             // placements of one pair of bodies
  size_t samples;        // of the motion, unless --motion-samples
  double turn[2];        // range of the angle turned over the motion, degrees
  double unit;           // metres; in units are:
  double moving[2];      // range of the largest extent of the moving body
  double fixed[2];       // of the fixed one
  double path[2];        // range of the length of the motion
  double march[2];       // of the step of the march
  double sigma;          // of eps, unless --sigma
  const char *what;
} set_info;

// clang-format off
static const set_info sets[] = {
    {"standard", ACROSS,     PLAIN,           SOLIDS, NONE,           0,   3,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "bodies of 0.1-0.4 m, paths of 0.1-0.6 m, up to 120 degrees"},
    {"hollow",   IN_BOUNDS,  PLAIN,           SOLIDS, HOLLOWS,       60,   6,  33, {0, 120},   1,
     {0.02, 0.08}, {0.2, 0.4}, {0.05, 0.3}, {0.001, 0.005}, 0.010,
     "a small body in and about a cup, rack, drawer, ..."},
    {"inside",   CONTAINED,  PLAIN,           SOLIDS, SOLIDS,        40, 100,  33, {0, 120},   1,
     {0.02, 0.08}, {0.2, 0.4}, {0.01, 0.1}, {0, 0},         0.032,
     "a small body inside a solid, and as many free ones in cavities"},
    {"cavity",   IN_CAVITY,  PLAIN,           SOLIDS, CLOSED_SHELLS, 30,   6,  33, {0, 120},   1,
     {0.02, 0.08}, {0.2, 0.4}, {0.02, 0.2}, {0.001, 0.005}, 0.010,
     "hollow, in the cavity of a shell that is closed all round"},
    {"thin",     ACROSS,     PATH_IN_EXTENTS, SHEETS, NONE,           0,   3,  33, {0, 60},    1,
     {0.1, 0.4},   {0.1, 0.4}, {3, 10},     {0.002, 0.015}, 0.032,
     "plates, 0.5-2 % thick, fly 3-10 of their extents past plates"},
    {"spin",     ACROSS,     PLAIN,           SOLIDS, NONE,           0,   3, 129, {720, 720}, 1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard, but 720 degrees of rotation"},
    {"still",    ACROSS,     HALF_SINGLE,     SOLIDS, NONE,           0,   3,  33, {0, 1},     1,
     {0.1, 0.4},   {0.1, 0.4}, {0, 0.001},  {0.002, 0.015}, 0.032,
     "standard, but half a single pose, half at most 1 mm and 1 degree"},
    {"tiny",     ACROSS,     PLAIN,           SOLIDS, NONE,           0,   3,  33, {0, 120},   1.0 / 200,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard / 200: bodies of 0.5-2 mm"},
    {"huge",     ACROSS,     PLAIN,           SOLIDS, NONE,           0,   3,  33, {0, 120},   400,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard * 400: bodies of 40-160 m"},
    {"far",      APART,      PLAIN,           SOLIDS, NONE,           0,  20,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0, 0},         0.032,
     "standard, but a gap of at least the larger extent: all free"},
    {"offset",   ACROSS,     FAR_FROM_ORIGIN, SOLIDS, NONE,           0,   3,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard, 10 km from the origin, in poses of float32"},
    {"mixed",    ON_SURFACE, PLAIN,           SOLIDS, NONE,           0,   6,  33, {0, 120},   1,
     {0.05, 0.05}, {20, 20},   {0.1, 0.6},  {0.002, 0.015}, 0.010,
     "a body of 5 cm at the surface of one of 20 m"},
    {"rest",     ON_FLOOR,   PLAIN,           RESTING, FLOORS,       30,  10,  33, {0, 90},    1,
     {0.03, 0.2},  {0.2, 0.5}, {0.01, 0.1}, {0, 0},         0.032,
     "a body stands on, slides on, leaves a tile, table, crate, plate"},
    {"nested",   PARTLY_IN,  PLAIN,           GROUPS, HOSTS,         40, 100,  33, {0, 60},    1,
     {0.4, 0.7},   {0.2, 0.4}, {0.01, 0.1}, {0, 0},         0.032,
     "of two or three parts one is inside a solid, or in a cavity"},
    {"slivers",  ACROSS,     PLAIN,           NEEDLES, NONE,          0,   3,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard, of triangles like needles, 1 to 1000 and worse"},
    {"soup",     ACROSS,     SURFACES_ONLY,   SOUP,   NONE,           0,   3,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard, with double, flat and shuffled triangles"},
    {"one",      ACROSS,     SURFACES_ONLY,   SOLIDS, TRIANGLES,     40,   3,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.002, 0.015}, 0.032,
     "standard, but one body or both are a single triangle"},
    {"same",     ALIKE,      HALF_TINY,       SOLIDS, NONE,           0,   3,  33, {0, 120},   1,
     {0.1, 0.4},   {0.1, 0.4}, {0.1, 0.6},  {0.005, 0.020}, 0.005,
     "a body against itself, 2 mm and 1 degree off, or just outside"},
};
// clang-format on
#define SETS (sizeof sets / sizeof *sets)

// ------------------------------------------------------------------------------------ mesh sources

typedef struct source {
  char name[64];
  char path[PATH_MAX];  // as written to the problem file
  shapes_mesh mesh;
  double extent;  // largest, in file units
  int used;
  set_floor floor;  // FLOORS only
  int shell;        // HOSTS only: has a cavity
} source;

typedef struct pool {
  source *items;
  size_t count, capacity;
} pool;

static source *pool_add(pool *p) {
  if (p->count == p->capacity) {
    p->capacity = p->capacity ? 2 * p->capacity : 64;
    p->items = (source *)realloc(p->items, p->capacity * sizeof *p->items);
    if (!p->items) exit(1);
  }
  memset(&p->items[p->count], 0, sizeof *p->items);
  return &p->items[p->count++];
}

static void pool_free(pool *p) {
  for (size_t i = 0; i < p->count; i++) shapes_free(&p->items[i].mesh);
  free(p->items);
}

// A minimal OBJ reader for known good files: v and f lines only. To be replaced by nsvcd_obj_load.
static int read_obj(const char *path, shapes_mesh *mesh) {
  FILE *file = fopen(path, "r");
  char line[4096];
  if (!file) return 0;
  while (fgets(line, sizeof line, file)) {
    double x, y, z;
    if (line[0] == 'v' && line[1] == ' ' && sscanf(line + 1, "%lf %lf %lf", &x, &y, &z) == 3)
      shapes_vertex(mesh, x, y, z);
    if (line[0] != 'f' || line[1] != ' ') continue;
    uint32_t corner[3] = {0, 0, 0};
    int n = 0;
    for (char *at = strtok(line + 1, " \t\r\n"); at; at = strtok(NULL, " \t\r\n"), n++) {
      long index = strtol(at, NULL, 10);
      index = index < 0 ? (long)mesh->vertices + index : index - 1;
      if (index < 0 || index >= (long)mesh->vertices) {
        mesh->failed = 1;
        break;
      }
      corner[n < 2 ? n : 2] = (uint32_t)index;
      if (n >= 2) shapes_triangle(mesh, corner[0], corner[1], corner[2]);
      if (n >= 2) corner[1] = corner[2];
    }
  }
  fclose(file);
  return !mesh->failed && mesh->triangles > 0;
}

static void measure(source *s) {
  double low[3], high[3];
  shapes_bounds(&s->mesh, low, high);
  s->extent = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
}

// The path of `target` as seen from the folder `from`; both must exist.
static void relative_path(const char *from, const char *target, char *out, size_t size) {
  char a[PATH_MAX], b[PATH_MAX];
  if (!realpath(from, a) || !realpath(target, b)) {
    snprintf(out, size, "%s", target);
    return;
  }
  size_t same = 0;
  size_t i = 0;
  for (; a[i] && a[i] == b[i]; i++)
    if (a[i] == '/') same = i;
  if (!a[i] && b[i] == '/') same = i;
  size_t used = 0;
  out[0] = 0;
  for (const char *rest = a + same; *rest; rest++)
    if (*rest == '/' && rest[1] && used + 4 < size) memcpy(out + used, "../", 4), used += 3;
  snprintf(out + used, size - used, "%s", b + same + 1);
}

static int compare_names(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

// Names to read: the lines of `list`, or all *.obj of the folder in alphabetical order.
static size_t list_names(const char *folder, const char *list, char ***names) {
  size_t count = 0;
  size_t capacity = 4096;
  *names = (char **)calloc(capacity, sizeof **names);
  DIR *directory = list ? NULL : opendir(folder);
  FILE *file = list ? fopen(list, "r") : NULL;
  char line[1024];
  for (;;) {
    if (directory) {
      struct dirent *entry = readdir(directory);
      if (!entry) break;
      snprintf(line, sizeof line, "%s", entry->d_name);
    } else if (!file || !fgets(line, sizeof line, file)) {
      break;
    }
    line[strcspn(line, "\r\n")] = 0;
    size_t n = strlen(line);
    if (n < 5 || strcmp(line + n - 4, ".obj") != 0 || count == capacity) continue;
    (*names)[count] = (char *)malloc(n + 1);
    memcpy((*names)[count++], line, n + 1);
  }
  if (directory) closedir(directory);
  if (file) fclose(file);
  qsort(*names, count, sizeof **names, compare_names);
  return count;
}

typedef enum open_policy { CLOSED_ONLY, OPEN_TOO, OPEN_ONLY } open_policy;

static void load_folder(pool *p, const char *folder, const char *list, open_policy policy,
                        const char *out_folder) {
  char **names;
  size_t count = list_names(folder, list, &names);
  size_t refused = 0;
  for (size_t i = 0; i < count; i++) {
    source s;
    char path[PATH_MAX];
    memset(&s, 0, sizeof s);
    snprintf(path, sizeof path, "%s/%s", folder, names[i]);
    int good = read_obj(path, &s.mesh);
    if (good) measure(&s);
    int closed = good && oracle_is_closed(s.mesh.positions, s.mesh.vertices, s.mesh.indices,
                                          s.mesh.triangles);
    if (!good || s.extent <= 0 || (policy == CLOSED_ONLY && !closed) ||
        (policy == OPEN_ONLY && closed)) {
      shapes_free(&s.mesh);
      refused++;
    } else {
      snprintf(s.name, sizeof s.name, "%.*s",
               (int)(strlen(names[i]) > 67 ? 63 : strlen(names[i]) - 4), names[i]);
      relative_path(out_folder, path, s.path, sizeof s.path);
      *pool_add(p) = s;
    }
    free(names[i]);
  }
  free(names);
  fprintf(stderr, "%s: %zu meshes, %zu refused\n", folder, p->count, refused);
}

// A mesh of one of the families of set_shapes.h, the i-th of its pool.
static void make_special(source *s, shapes_rng *rng, family kind, size_t i) {
  switch (kind) {
    case RESTING:
      set_resting(&s->mesh, rng, (int)(i % SET_RESTING));
      break;
    case FLOORS:
      s->floor = set_make_floor(&s->mesh, rng, (int)(i % SET_FLOORS));
      break;
    case GROUPS:
      set_group(&s->mesh, rng);
      break;
    case HOSTS:
      s->shell = (int)(i % 2);
      set_host(&s->mesh, rng, s->shell);
      break;
    case NEEDLES:
      set_slivers(&s->mesh, rng, (int)(i % SET_SLIVERS));
      break;
    case SOUP:
      set_soup(&s->mesh, rng);
      break;
    default:
      set_triangle(&s->mesh, rng, i % 4 == 3);
      break;
  }
}
// Makes `count` meshes of a family and writes them beside the problem file:
// NAME_meshes/PREFIXnnn.obj.
static void make_procedural(pool *p, shapes_rng *rng, family kind, size_t count, const char *prefix,
                            const char *out_path) {
  char base[1024], folder[1100], path[1200];
  snprintf(base, sizeof base, "%s", out_path);
  char *dot = strrchr(base, '.');
  char *slash = strrchr(base, '/');
  if (dot && dot > slash) *dot = 0;
  snprintf(folder, sizeof folder, "%s_meshes", base);
  if (mkdir(folder, 0777) != 0 && errno != EEXIST) exit(1);
  for (size_t i = 0; i < count; i++) {
    source *s = pool_add(p);
    if (kind >= RESTING)
      make_special(s, rng, kind, i);
    else if (kind == SOLIDS)
      shapes_random_solid(&s->mesh, rng, 0.3);
    else if (kind == HOLLOWS)
      shapes_random_hollow(&s->mesh, rng, (int)(i % SHAPES_HOLLOWS), 0.3);
    else if (kind == SHELLS && i % 3 == 2)
      shapes_random_hollow(&s->mesh, rng, 0, 0.3);
    else if (kind == SHEETS) {
      double y = shapes_uniform(rng, 0.3, 1);
      double z = shapes_uniform(rng, 0.005, 0.02);
      shapes_box(&s->mesh, 1, y, z, 1 + shapes_pick(rng, 4));
      shapes_fit(&s->mesh, 0.3);
    } else {
      // One draw per statement: C leaves the order of a call's arguments open.
      int segments = 24 + 4 * shapes_pick(rng, 4);
      double wall = shapes_uniform(rng, 0.04, 0.12);
      double z = shapes_uniform(rng, 0.7, 1);
      double y = shapes_uniform(rng, 0.7, 1);
      shapes_shell(&s->mesh, 1, y, z, wall, (int)(kind == SHELLS ? i % 3 : i % 2), segments);
      shapes_fit(&s->mesh, 0.3);
    }
    measure(s);
    snprintf(s->name, sizeof s->name, "%s%03zu", prefix, i);
    snprintf(path, sizeof path, "%s/%s.obj", folder, s->name);
    if (!shapes_write_obj(&s->mesh, path)) exit(1);
    snprintf(s->path, sizeof s->path, "%s_meshes/%s.obj", slash ? base + (slash - base) + 1 : base,
             s->name);
  }
}

// ------------------------------------------------------------------------------------------ motion

typedef struct problem {
  const set_info *set;
  source *moving_source, *fixed_source;
  double moving_extent, fixed_extent, moving_scale, fixed_scale;
  oracle_mesh moving, fixed;
  oracle_pose motion[MAX_SAMPLES], fixed_pose;
  size_t samples;
  size_t id;
  int swapped;  // the body of the second pool moves
  int label;
  double margin;
} problem;

// A cubic Bezier of arc length `length` from the origin, sampled evenly in its parameter.
static void random_path(shapes_rng *rng, double length, double (*path)[3], size_t samples) {
  double control[4][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  double along[3];
  double total = 0;
  double bend = shapes_uniform(rng, 0, 0.5);
  shapes_direction(rng, along);
  for (int i = 1; i < 4; i++)
    for (int k = 0; k < 3; k++) control[i][k] = along[k] * i / 3 + bend * shapes_normal(rng);
  for (size_t s = 0; s < samples; s++) {
    double t = samples > 1 ? (double)s / (double)(samples - 1) : 0;
    double u = 1 - t;
    double d[3];
    for (int k = 0; k < 3; k++)
      path[s][k] =
          3 * u * u * t * control[1][k] + 3 * u * t * t * control[2][k] + t * t * t * control[3][k];
    if (s) {
      oracle_sub(path[s], path[s - 1], d);
      total += oracle_length(d);
    }
  }
  for (size_t s = 0; s < samples && total > 0; s++)
    for (int k = 0; k < 3; k++) path[s][k] *= length / total;
}
static void set_pose(oracle_pose *pose, const double *center, const double *q,
                     const double *mesh_center) {
  double m[9], c[3];
  memcpy(pose->rotation, q, sizeof pose->rotation);
  oracle_matrix(q, m);
  oracle_rotate(m, mesh_center, c);
  oracle_sub(center, c, pose->position);
}
// The centre of the moving body's bounds follows the path from `start`; it turns about a slowly
// changing axis.
static void random_motion(shapes_rng *rng, problem *p, const double *start, double length,
                          double turn) {
  static double path[MAX_SAMPLES][3];
  double q[4], axis[3], drift[3];
  random_path(rng, length, path, p->samples);
  shapes_quaternion(rng, q);
  shapes_direction(rng, axis);
  shapes_direction(rng, drift);
  for (size_t s = 0; s < p->samples; s++) {
    double center[3], now[3], step[4], next[4], n;
    for (int k = 0; k < 3; k++) {
      center[k] = start[k] + path[s][k];
      now[k] = axis[k] + 0.7 * drift[k] * (double)s / (double)p->samples;
    }
    if (s) {
      n = oracle_length(now);
      for (int k = 0; k < 3; k++) now[k] /= n;
      oracle_axis_angle(now, turn / (double)(p->samples - 1), step);
      oracle_quat_mul(step, q, next);
      oracle_quat_normalize(next);
      memcpy(q, next, sizeof q);
    }
    set_pose(&p->motion[s], center, q, p->moving.center);
  }
}
// What a reader of floats gets. volatile: where gcc 12.2 vectorizes (double)(float)x (straight-line
// code, from -O2 on), it drops both conversions.
static double round_to_float(double x) {
  volatile float rounded = (float)x;
  return (double)rounded;
}
static void round_pose(oracle_pose *pose) {
  for (int k = 0; k < 3; k++) pose->position[k] = round_to_float(pose->position[k]);
  for (int k = 0; k < 4; k++) pose->rotation[k] = round_to_float(pose->rotation[k]);
}
static double draw(shapes_rng *rng, const double *range) {
  return shapes_uniform(rng, range[0], range[1]);
}
static double draw_turn(shapes_rng *rng, const problem *p) {  // radians
  return shapes_uniform(rng, p->set->turn[0] * SHAPES_PI / 180, p->set->turn[1] * SHAPES_PI / 180);
}
static double draw_path(shapes_rng *rng, const problem *p) {
  return draw(rng, p->set->path) *
         (p->set->special == PATH_IN_EXTENTS ? p->moving_extent : p->set->unit);
}
static void motion_center(const problem *p, size_t s, double *out) {
  oracle_transform(&p->motion[s], p->moving.center, out);
}

// ----------------------------------------------------------------------------------- the procedure

typedef struct counts {
  size_t accepted[2], placed, no_free_place, not_touching, undecided, unbalanced, other;
  size_t histogram[2][6];
} counts;

static oracle_pose offset_pose(const oracle_pose *pose, const double *direction, double s) {
  oracle_pose out = *pose;
  for (int k = 0; k < 3; k++) out.position[k] += s * direction[k];
  return out;
}
// Counts why an attempt came to nothing.
static int rejected(size_t *reason) {
  *reason += 1;
  return 0;
}
// The full answer if enough is 0; otherwise whether the separation exceeds `enough`.
static oracle_result ask(const problem *p, const oracle_pose *fixed_pose, double enough) {
  oracle_options o = {TOLERANCE * p->set->unit, 0, 0, 0};
  o.enough = enough;
  return oracle_sweep(&p->moving, p->motion, p->samples, &p->fixed, fixed_pose, &o);
}
static int is_free(const problem *p, const oracle_pose *fixed_pose) {
  return ask(p, fixed_pose, UNDECIDED * p->set->unit).status == ORACLE_FREE;
}
// Step 2: the first free place along a random direction, at most 60 steps away.
static int march_out(shapes_rng *rng, problem *p, double step) {
  double direction[3];
  shapes_direction(rng, direction);
  for (int i = 0; i < 60; i++) {
    oracle_pose here = offset_pose(&p->fixed_pose, direction, i * step);
    if (!is_free(p, &here)) continue;
    p->fixed_pose = here;
    return 1;
  }
  return 0;
}
// Step 3: moves the fixed body until it just touches; direction (unit) then points deeper.
static int touch(problem *p, double *direction) {
  double unit = p->set->unit;
  oracle_result r = ask(p, &p->fixed_pose, 0);
  if (r.status != ORACLE_FREE) return 0;
  oracle_sub(r.on_moving, r.on_fixed, direction);
  double length = oracle_length(direction);
  if (length < 1e-9 * unit) return 0;
  for (int k = 0; k < 3; k++) direction[k] /= length;
  oracle_pose just_short = offset_pose(&p->fixed_pose, direction, r.distance - UNDECIDED * unit);
  oracle_result check = ask(p, &just_short, TOUCHING * unit);
  if ((check.status != ORACLE_FREE && check.status != ORACLE_UNDECIDED) ||
      check.distance > TOUCHING * unit)
    return 0;
  p->fixed_pose = offset_pose(&p->fixed_pose, direction, r.distance);
  return 1;
}
// The shortest way back from the offset eps towards 0 along direction after which the motion is
// free.
static double depth(const problem *p, const double *direction, double eps) {
  double colliding = eps;
  double open = 0;
  for (int i = 1; i < 8; i++) {
    double s = eps * (8 - i) / 8;
    oracle_pose here = offset_pose(&p->fixed_pose, direction, s);
    if (is_free(p, &here)) {
      open = s;
      break;
    }
    colliding = s;
  }
  while (fabs(colliding - open) > TOLERANCE * p->set->unit) {
    double s = (colliding + open) / 2;
    oracle_pose here = offset_pose(&p->fixed_pose, direction, s);
    if (is_free(p, &here))
      open = s;
    else
      colliding = s;
  }
  return fabs(eps - open);
}
// Is a place of the world, off all surfaces, in the cavity of a convex shell? Seen from there the
// outer surface is all round, so that the triangles that show their backs fill the sphere; seen
// from outside they fill less than half of it for the outer surface, still less for the inner one.
static int surrounds(const oracle_mesh *shell, const oracle_pose *pose, const double *world) {
  double m[9];
  double away[3];
  double point[3];
  double backs = 0;
  oracle_sub(world, pose->position, away);
  oracle_matrix(pose->rotation, m);
  oracle_rotate_back(m, away, point);
  for (size_t i = 0; i < shell->triangle_count; i++) {
    oracle_mesh one = *shell;
    one.triangles += i;
    one.triangle_count = 1;
    backs += fmax(0, oracle_winding(&one, point));
  }
  return backs > 0.995;
}
// Where nothing touches: is the moving body, at the start, in the cavity of the fixed one?
static int in_cavity(const problem *p) {
  double world[3];
  oracle_transform(&p->motion[0], p->moving.seeds, world);
  return surrounds(&p->fixed, &p->fixed_pose, world);
}
// Steps 4 and 5. Returns 1 with label and margin.
static int perturb(shapes_rng *rng, problem *p, const double *direction, double sigma, counts *c) {
  oracle_pose touching = p->fixed_pose;
  for (int attempt = 0; attempt < 4; attempt++) {
    double eps = sigma * shapes_normal(rng);
    oracle_pose here = offset_pose(&touching, direction, eps);
    oracle_pose back = touching;
    if (p->set->special == FAR_FROM_ORIGIN) {
      round_pose(&here);
      back = offset_pose(&here, direction, -eps);
    }
    oracle_result r = ask(p, &here, 0);
    double surely = p->set->special == SURFACES_ONLY ? 1e9 : 0.75;  // inside; 1e9: never
    if (r.status == ORACLE_UNDECIDED || (r.winding > 0.25 && r.winding < surely)) {
      c->undecided++;
      continue;
    }
    p->label = r.status != ORACLE_FREE;
    if (c->accepted[p->label] > c->accepted[!p->label] + 4) {
      c->unbalanced++;
      continue;
    }
    p->fixed_pose = back;
    p->margin = p->label ? -depth(p, direction, eps) : r.distance;
    if (fabs(p->margin) < UNDECIDED * p->set->unit) {
      c->undecided++;
      continue;
    }
    p->fixed_pose = here;
    if (p->set->placing == IN_CAVITY && !p->label && !in_cavity(p)) {  // went through the wall
      c->other++;
      continue;
    }
    return 1;
  }
  return 0;
}
static int load_body(oracle_mesh *mesh, source *s, double extent, double *scale) {
  *scale = extent / s->extent;
  return oracle_mesh_init(mesh, s->mesh.positions, s->mesh.vertices, s->mesh.indices,
                          s->mesh.triangles, *scale);
}
static source *any(shapes_rng *rng, pool *p) {
  return &p->items[shapes_next(rng) % p->count];
}

// Step 1, ACROSS.
static void place_across(shapes_rng *rng, problem *p) {
  double low[3];
  double high[3];
  double q[4];
  double center[3];
  double origin[3] = {0, 0, 0};
  if (p->set->special == FAR_FROM_ORIGIN) {
    shapes_direction(rng, origin);
    for (int k = 0; k < 3; k++) origin[k] *= ORIGIN_DISTANCE;
  }
  double turn = draw_turn(rng, p);
  double length = draw_path(rng, p);
  random_motion(rng, p, origin, length, turn);
  if (p->set->special == FAR_FROM_ORIGIN)
    for (size_t s = 0; s < p->samples; s++) round_pose(&p->motion[s]);
  for (int k = 0; k < 3; k++) {
    low[k] = HUGE_VAL;
    high[k] = -HUGE_VAL;
  }
  for (size_t s = 0; s < p->samples; s++) {
    motion_center(p, s, center);
    for (int k = 0; k < 3; k++) {
      low[k] = fmin(low[k], center[k]);
      high[k] = fmax(high[k], center[k]);
    }
  }
  double reach = 0.6 * (p->moving.radius + p->fixed.radius);
  for (int k = 0; k < 3; k++) center[k] = shapes_uniform(rng, low[k] - reach, high[k] + reach);
  shapes_quaternion(rng, q);
  set_pose(&p->fixed_pose, center, q, p->fixed.center);
}
// A random place within the bounds of a posed mesh, in the world.
static void within(shapes_rng *rng, const oracle_mesh *mesh, const oracle_pose *pose, double *out) {
  double local[3];
  for (int k = 0; k < 3; k++) local[k] = shapes_uniform(rng, mesh->low[k], mesh->high[k]);
  oracle_transform(pose, local, out);
}
// Step 1, IN_BOUNDS and IN_CAVITY: the moving body starts within the bounds of the fixed one, free
// there.
static int place_in_bounds(shapes_rng *rng, problem *p) {
  double q[4];
  double start[3];
  double origin[3] = {0, 0, 0};
  shapes_quaternion(rng, q);
  set_pose(&p->fixed_pose, origin, q, p->fixed.center);
  within(rng, &p->fixed, &p->fixed_pose, start);
  double turn = draw_turn(rng, p);
  double length = draw_path(rng, p);
  random_motion(rng, p, start, length, turn);
  size_t samples = p->samples;
  p->samples = 1;  // at t = 0
  int ok = is_free(p, &p->fixed_pose);
  p->samples = samples;
  return ok;
}
static double triangle_area(const oracle_triangle *t) {
  double e0[3], e1[3], n[3];
  oracle_sub(t->v[1], t->v[0], e0);
  oracle_sub(t->v[2], t->v[0], e1);
  oracle_cross(e0, e1, n);
  return oracle_length(n) / 2;
}
// A random place on the surface, uniform by area, in the world.
static void on_surface(shapes_rng *rng, const oracle_mesh *mesh, const oracle_pose *pose,
                       double *out) {
  double area = 0;
  double local[3];
  double u = shapes_uniform(rng, 0, 1);
  double v = shapes_uniform(rng, 0, 1);
  const oracle_triangle *t = mesh->triangles;
  const oracle_triangle *end = t + mesh->triangle_count;
  for (; t < end; t++) area += triangle_area(t);
  area = shapes_uniform(rng, 0, area);
  for (t = mesh->triangles; t + 1 < end && area > triangle_area(t); t++) area -= triangle_area(t);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  for (int k = 0; k < 3; k++)
    local[k] = t->v[0][k] + u * (t->v[1][k] - t->v[0][k]) + v * (t->v[2][k] - t->v[0][k]);
  oracle_transform(pose, local, out);
}
// Step 1, ON_SURFACE: at a random time the moving body's centre is within its reach of a random
// place of the surface.
static void place_on_surface(shapes_rng *rng, problem *p) {
  double q[4];
  double origin[3] = {0, 0, 0};
  double place[3];
  double center[3];
  double away[3];
  double turn = draw_turn(rng, p);
  double length = draw_path(rng, p);
  random_motion(rng, p, origin, length, turn);
  shapes_quaternion(rng, q);
  shapes_direction(rng, away);
  set_pose(&p->fixed_pose, origin, q, p->fixed.center);
  on_surface(rng, &p->fixed, &p->fixed_pose, place);
  motion_center(p, (size_t)shapes_pick(rng, (int)p->samples), center);
  double reach = shapes_uniform(rng, 0, p->moving.radius);
  for (int k = 0; k < 3; k++) p->fixed_pose.position[k] += center[k] + reach * away[k] - place[k];
}
// Does the moving body's centre pass through the bounds of the fixed one, grown by a tenth?
static int passes_through(const problem *p) {
  double m[9];
  oracle_matrix(p->fixed_pose.rotation, m);
  for (size_t s = 0; s < p->samples; s++) {
    double center[3], local[3];
    int within_bounds = 1;
    motion_center(p, s, center);
    oracle_sub(center, p->fixed_pose.position, center);
    oracle_rotate_back(m, center, local);
    for (int k = 0; k < 3; k++)
      within_bounds = within_bounds && fabs(local[k] - p->fixed.center[k]) <
                                           0.6 * (p->fixed.high[k] - p->fixed.low[k]);
    if (within_bounds) return 1;
  }
  return 0;
}
// One attempt at a problem, by steps 1 to 5.
static int attempt(shapes_rng *rng, problem *p, double sigma, counts *c) {
  double direction[3];
  placing placing = p->set->placing;
  int free_start = 1;
  c->placed++;
  if (placing == IN_BOUNDS || placing == IN_CAVITY)
    free_start = place_in_bounds(rng, p);
  else if (placing == ON_SURFACE)
    place_on_surface(rng, p);
  else
    place_across(rng, p);
  if (!free_start || (placing == IN_CAVITY && !in_cavity(p))) return c->no_free_place++, 0;
  if (!march_out(rng, p, p->set->unit * draw(rng, p->set->march))) return c->no_free_place++, 0;
  if (placing == IN_BOUNDS && !passes_through(p)) return c->other++, 0;
  if (placing == IN_CAVITY && !in_cavity(p)) return c->other++, 0;
  if (!touch(p, direction)) return c->not_touching++, 0;
  return perturb(rng, p, direction, sigma, c);
}
// One attempt at `far`: the fixed body is put somewhere beyond the gap, as seen from some place of
// the motion.
static int attempt_far(shapes_rng *rng, problem *p, counts *c) {
  double q[4];
  double origin[3] = {0, 0, 0};
  double center[3];
  double away[3];
  double gap = fmax(p->moving_extent, p->fixed_extent);
  double turn = draw_turn(rng, p);
  double length = draw_path(rng, p);
  c->placed++;
  random_motion(rng, p, origin, length, turn);
  shapes_quaternion(rng, q);
  shapes_direction(rng, away);
  motion_center(p, (size_t)shapes_pick(rng, (int)p->samples), center);
  double distance = p->moving.radius + p->fixed.radius + gap * shapes_uniform(rng, 0.5, 3);
  for (int k = 0; k < 3; k++) center[k] += distance * away[k];
  set_pose(&p->fixed_pose, center, q, p->fixed.center);
  oracle_result r = ask(p, &p->fixed_pose, 0);
  if (r.status != ORACLE_FREE || r.lower < gap) return c->other++, 0;
  p->label = 0;
  p->margin = r.distance;
  return 1;
}
// One attempt at `inside`: a small body starts within the bounds of a large one; nothing may touch,
// with 1 mm to spare.
static int attempt_inside(shapes_rng *rng, problem *p, int label, int large_moves, counts *c) {
  double q[4];
  double origin[3] = {0, 0, 0};
  double start[3];
  double length = draw_path(rng, p);
  double turn = draw_turn(rng, p);
  double clearance = CLEARANCE * p->set->unit;
  c->placed++;
  shapes_quaternion(rng, q);
  if (large_moves) {
    random_motion(rng, p, origin, length, turn);
    within(rng, &p->moving, &p->motion[0], start);
    set_pose(&p->fixed_pose, start, q, p->fixed.center);
  } else {
    set_pose(&p->fixed_pose, origin, q, p->fixed.center);
    within(rng, &p->fixed, &p->fixed_pose, start);
    random_motion(rng, p, start, length, turn);
  }
  oracle_result r = ask(p, &p->fixed_pose, label ? clearance : 0);
  if (r.status != (label ? ORACLE_INSIDE : ORACLE_FREE) || r.distance < clearance)
    return c->other++, 0;
  p->label = label;
  p->margin = label ? (double)NAN : r.distance;
  return 1;
}

// ---------------------------------------------------------------------------------- the set `rest`

typedef enum rest_move { STAND, SLIDE, SET_DOWN, LIFT } rest_move;

typedef struct rest_plan {
  int label;
  int whole;  // wholly within the floor
  int single;
  rest_move move;
  double gap;  // to the surface, metres; negative: pressed in
} rest_plan;

// What the problem of this number is to be: labels, gaps and motions in turn.
static rest_plan plan_rest(size_t id) {
  static const double gaps[] = {2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2};
  const size_t count = sizeof gaps / sizeof *gaps;
  const size_t turn = id / 2;
  const size_t slot = turn % (count + 1);
  const size_t round = turn / (count + 1);
  const double gap = gaps[slot ? slot - 1 : round % count];
  rest_plan plan;
  plan.label = (int)(id % 2);
  plan.whole = plan.label && slot == 0;
  plan.gap = plan.label ? -gap : gap;
  plan.move = (rest_move)((turn + round) % 4);
  if (plan.whole && plan.move > SLIDE) plan.move = SLIDE;  // neither comes in nor leaves
  plan.single = plan.move == STAND && turn / 4 % 2;
  return plan;
}
static void turn_by(double *q, const double *axis, double angle) {
  double step[4];
  double turned[4];
  oracle_axis_angle(axis, angle, step);
  oracle_quat_mul(step, q, turned);
  oracle_quat_normalize(turned);
  memcpy(q, turned, sizeof turned);
}
// From one corner to another, both turned by the matrix. Corner i is that of triangle i / 3.
static void corner_to_corner(const oracle_mesh *mesh, size_t from, size_t to, const double *m,
                             double *out) {
  double d[3];
  oracle_sub(mesh->triangles[to / 3].v[to % 3], mesh->triangles[from / 3].v[from % 3], d);
  oracle_rotate(m, d, out);
}
static size_t lowest_corner(const oracle_mesh *mesh, const double *q) {
  double m[9];
  size_t lowest = 0;
  oracle_matrix(q, m);
  for (size_t i = 1; i < 3 * mesh->triangle_count; i++) {
    double d[3];
    corner_to_corner(mesh, lowest, i, m, d);
    if (d[2] < 0) lowest = i;
  }
  return lowest;
}
// Tilts the body about its lowest corner until a second one is as low. `along` (unit) then points
// there.
static int tilt_to_edge(const oracle_mesh *mesh, size_t lowest, double *q, double *along) {
  double m[9];
  double slope = HUGE_VAL;
  oracle_matrix(q, m);
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    double d[3];
    corner_to_corner(mesh, lowest, i, m, d);
    const double run = hypot(d[0], d[1]);
    if (run < 1e-6 * mesh->radius || d[2] / run >= slope) continue;
    slope = d[2] / run;
    along[0] = d[0] / run;
    along[1] = d[1] / run;
    along[2] = 0;
  }
  if (slope > 1e150) return 0;
  const double axis[3] = {-along[1], along[0], 0};
  turn_by(q, axis, atan(slope));
  return 1;
}
// Tilts it on about that edge, to the side of `sign`, until a third corner is as low.
static void tilt_to_face(const oracle_mesh *mesh, size_t lowest, double *q, const double *along,
                         int sign) {
  const double side[3] = {-sign * along[1], sign * along[0], 0};
  const double axis[3] = {-sign * along[0], -sign * along[1], 0};
  double m[9];
  double slope = HUGE_VAL;
  oracle_matrix(q, m);
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    double d[3];
    corner_to_corner(mesh, lowest, i, m, d);
    const double run = oracle_dot(d, side);
    if (run > 1e-6 * mesh->radius) slope = fmin(slope, d[2] / run);
  }
  if (slope < 1e150) turn_by(q, axis, atan(slope));
}
// How the body stands: as in its file, after quarter turns, or on a face of its convex hull; then
// turned about the vertical, or not.
static void rest_rotation(shapes_rng *rng, const oracle_mesh *mesh, double *q) {
  const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double still[4] = {0, 0, 0, 1};
  const int way = shapes_pick(rng, 3);
  memcpy(q, still, sizeof still);
  for (int k = 0; k < 3 && way == 1; k++) turn_by(q, axes[k], shapes_pick(rng, 4) * SHAPES_PI / 2);
  if (way == 2) {
    double along[3] = {0, 0, 0};
    shapes_quaternion(rng, q);
    const int sign = shapes_pick(rng, 2) ? 1 : -1;
    const size_t lowest = lowest_corner(mesh, q);
    if (tilt_to_edge(mesh, lowest, q, along)) tilt_to_face(mesh, lowest, q, along, sign);
  }
  if (shapes_pick(rng, 2)) turn_by(q, axes[2], shapes_uniform(rng, 0, 2 * SHAPES_PI));
}

typedef struct box {
  double low[3];
  double high[3];
} box;

static box turned_bounds(const oracle_mesh *mesh, const double *q) {
  box out = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  double m[9];
  oracle_matrix(q, m);
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    double place[3];
    oracle_rotate(m, mesh->triangles[i / 3].v[i % 3], place);
    for (int k = 0; k < 3; k++) {
      out.low[k] = fmin(out.low[k], place[k]);
      out.high[k] = fmax(out.high[k], place[k]);
    }
  }
  return out;
}
// The body where it is at the gap, or within the floor. The fixed body is at the origin, z up.
// Between walls the whole body has to be over the flat part, elsewhere its middle.
static oracle_pose rest_pose(shapes_rng *rng, const problem *p, const rest_plan *plan) {
  const set_floor *floor = &p->fixed_source->floor;
  oracle_pose pose;
  rest_rotation(rng, &p->moving, pose.rotation);
  const box bounds = turned_bounds(&p->moving, pose.rotation);
  for (int k = 0; k < 2; k++) {
    const double size = bounds.high[k] - bounds.low[k];
    const double reach = p->fixed_scale * floor->half[k] - (floor->walled ? size / 2 : 0);
    const double place = fmax(reach, 0) * shapes_uniform(rng, -1, 1);
    pose.position[k] = place - (bounds.low[k] + bounds.high[k]) / 2;
  }
  const double surface = p->fixed_scale * floor->height;
  const double middle = surface - p->fixed_scale * floor->thickness * shapes_uniform(rng, 0.4, 0.6);
  if (plan->whole)
    pose.position[2] = middle - (bounds.low[2] + bounds.high[2]) / 2;
  else
    pose.position[2] = surface + plan->gap * p->set->unit - bounds.low[2];
  return pose;
}
// The pose turned by an angle about the vertical through a place, then moved.
static oracle_pose turned_pose(oracle_pose pose, const double *about, double angle,
                               const double *move) {
  const double up[3] = {0, 0, 1};
  const double x = pose.position[0] - about[0];
  const double y = pose.position[1] - about[1];
  pose.position[0] = about[0] + cos(angle) * x - sin(angle) * y + move[0];
  pose.position[1] = about[1] + sin(angle) * x + cos(angle) * y + move[1];
  pose.position[2] += move[2];
  turn_by(pose.rotation, up, angle);
  return pose;
}
// Never lower than `rest`, and as low as that all the time (STAND, SLIDE), at the end or at the
// start.
static void rest_motion(shapes_rng *rng, problem *p, rest_move move, const oracle_pose *rest) {
  const double heading = shapes_uniform(rng, 0, 2 * SHAPES_PI);
  const double length = draw_path(rng, p);
  const double rise = shapes_uniform(rng, 0.05, 0.2) * p->set->unit;
  const double yaw = draw_turn(rng, p);
  const double turn = move == STAND || shapes_pick(rng, 2) ? 0 : yaw;
  double about[3];
  oracle_transform(rest, p->moving.center, about);
  for (size_t s = 0; s < p->samples; s++) {
    const double t = p->samples > 1 ? (double)s / (double)(p->samples - 1) : 0;
    double by[3] = {0, 0, 0};
    if (move == SLIDE) {
      by[0] = (t - 0.5) * length * cos(heading);
      by[1] = (t - 0.5) * length * sin(heading);
    }
    if (move == SET_DOWN) by[2] = (1 - t) * rise;
    if (move == LIFT) by[2] = t * rise;
    p->motion[s] = turned_pose(*rest, about, (t - 0.5) * turn, by);
  }
}
static void move_scene(problem *p, const oracle_pose *scene) {
  p->fixed_pose = oracle_compose(scene, &p->fixed_pose);
  for (size_t s = 0; s < p->samples; s++) p->motion[s] = oracle_compose(scene, &p->motion[s]);
}
// Does the oracle agree with the plan? Sets label and margin. Walls that are nearer than the floor,
// or the edge of a floor that ends under the body, make another problem of it: rejected.
static int is_as_planned(problem *p, const rest_plan *plan) {
  const double up[3] = {0, 0, 1};
  const double undecided = UNDECIDED * p->set->unit;
  double m[9];
  double normal[3];
  oracle_matrix(p->fixed_pose.rotation, m);
  oracle_rotate(m, up, normal);
  const oracle_result r = ask(p, &p->fixed_pose, 0);
  p->label = plan->label;
  if (r.winding > 0.25 && r.winding < 0.75) return 0;  // an open mesh
  if (!plan->label) {
    p->margin = r.distance;
    return r.status == ORACLE_FREE && fabs(r.distance - plan->gap * p->set->unit) < undecided;
  }
  p->margin = (double)NAN;
  if (r.status == ORACLE_INSIDE) return r.distance > undecided;
  if (plan->whole || r.status != ORACLE_COLLIDES) return 0;
  const double depth = -plan->gap * p->set->unit;
  const oracle_pose less = offset_pose(&p->fixed_pose, normal, undecided - depth);
  const oracle_pose more = offset_pose(&p->fixed_pose, normal, -2 * undecided - depth);
  p->margin = -depth;
  return ask(p, &less, 0).status == ORACLE_COLLIDES && is_free(p, &more);
}
static int attempt_rest(shapes_rng *rng, problem *p, counts *c) {
  const rest_plan plan = plan_rest(p->id);
  const oracle_pose still = {{0, 0, 0}, {0, 0, 0, 1}};
  const oracle_pose rest = rest_pose(rng, p, &plan);
  c->placed++;
  p->fixed_pose = still;
  rest_motion(rng, p, plan.move, &rest);
  if (shapes_pick(rng, 2)) {  // else axis-aligned, z up
    oracle_pose scene;
    for (int k = 0; k < 3; k++) scene.position[k] = shapes_uniform(rng, -1, 1) * p->set->unit;
    shapes_quaternion(rng, scene.rotation);
    move_scene(p, &scene);
  }
  return is_as_planned(p, &plan) || rejected(&c->other);
}

// -------------------------------------------------------------------- the sets `nested` and `same`

// How many parts of one body are inside the other, where no surfaces touch.
static size_t parts_inside(const oracle_mesh *group, const oracle_pose *pose,
                           const oracle_mesh *host, const oracle_pose *host_pose) {
  size_t inside = 0;
  for (size_t i = 0; i < group->seed_count; i++) {
    oracle_mesh part = *group;
    part.seeds += 3 * i;
    part.seed_count = 1;
    inside += oracle_inside(&part, pose, host, host_pose) > 0.5;
  }
  return inside;
}
// Moves the pose so that a place of its body is at a place of the world.
static void pin(oracle_pose *pose, const double *local, const double *world) {
  double now[3];
  oracle_transform(pose, local, now);
  for (int k = 0; k < 3; k++) pose->position[k] += world[k] - now[k];
}
// A part of the group somewhere in the bounds of the host. Where the group moves, it turns about
// that part.
static void place_part(shapes_rng *rng, problem *p, const double *part) {
  const double origin[3] = {0, 0, 0};
  const double length = draw_path(rng, p);
  const double turn = draw_turn(rng, p);
  double q[4];
  double start[3];
  random_motion(rng, p, origin, length, turn);
  shapes_quaternion(rng, q);
  if (p->swapped) {
    within(rng, &p->moving, &p->motion[0], start);
    set_pose(&p->fixed_pose, start, q, p->fixed.center);
    pin(&p->fixed_pose, part, start);
    return;
  }
  set_pose(&p->fixed_pose, origin, q, p->fixed.center);
  within(rng, &p->fixed, &p->fixed_pose, start);
  for (size_t s = 0; s < p->samples; s++) {
    double place[3];
    motion_center(p, s, place);
    for (int k = 0; k < 3; k++) place[k] += start[k];
    pin(&p->motion[s], part, place);
  }
}
// One attempt at `nested`: a part of the group is put in the solid or wall (label 1), cavity or
// vicinity (0) of the host. Half of the groups move, half are fixed.
static int attempt_nested(shapes_rng *rng, problem *p, counts *c) {
  const oracle_mesh *group = p->swapped ? &p->fixed : &p->moving;
  const oracle_mesh *host = p->swapped ? &p->moving : &p->fixed;
  const oracle_pose *group_pose = p->swapped ? &p->fixed_pose : &p->motion[0];
  const oracle_pose *host_pose = p->swapped ? &p->motion[0] : &p->fixed_pose;
  const int shell = p->swapped ? p->moving_source->shell : p->fixed_source->shell;
  const double *part = group->seeds + 3 * shapes_pick(rng, (int)group->seed_count);
  const double clearance = CLEARANCE * p->set->unit;
  double place[3];
  p->label = (int)(p->id % 2);
  c->placed++;
  place_part(rng, p, part);
  oracle_transform(group_pose, part, place);
  int good = parts_inside(group, group_pose, host, host_pose) == (size_t)p->label;
  if (!p->label && shell) good = good && surrounds(host, host_pose, place);
  if (!good) return rejected(&c->no_free_place);
  const oracle_result r = ask(p, &p->fixed_pose, p->label ? clearance : 0);
  good = r.status == (p->label ? ORACLE_INSIDE : ORACLE_FREE) && r.distance >= clearance;
  p->margin = p->label ? (double)NAN : r.distance;
  return good || rejected(&c->other);
}
// The fixed body where the moving one is at some time, up to 2 mm and 1 degree off.
static void place_alike(shapes_rng *rng, problem *p) {
  const oracle_pose *there = &p->motion[shapes_pick(rng, (int)p->samples)];
  const double angle = shapes_uniform(rng, 0, SHAPES_PI / 180);
  const double offset = shapes_uniform(rng, 0, 2e-3) * p->set->unit;
  double axis[3];
  double away[3];
  double center[3];
  double q[4];
  shapes_direction(rng, axis);
  shapes_direction(rng, away);
  oracle_transform(there, p->moving.center, center);
  for (int k = 0; k < 3; k++) center[k] += offset * away[k];
  memcpy(q, there->rotation, sizeof q);
  turn_by(q, axis, angle);
  set_pose(&p->fixed_pose, center, q, p->fixed.center);
}
// One attempt at `same`. Every other problem is left where the bodies cross; the rest march out and
// go on like the others, where keeping the balance makes most of them free.
static int attempt_same(shapes_rng *rng, problem *p, double sigma, counts *c) {
  const int tiny = p->id / 2 % 2;
  const double origin[3] = {0, 0, 0};
  double length = draw_path(rng, p);
  double turn = draw_turn(rng, p);
  double direction[3];
  c->placed++;
  if (tiny) {
    length = shapes_uniform(rng, 0, 1e-3) * p->set->unit;
    turn = shapes_uniform(rng, 0, SHAPES_PI / 180);
  }
  random_motion(rng, p, origin, length, turn);
  place_alike(rng, p);
  const oracle_pose crossing = p->fixed_pose;
  if (ask(p, &crossing, 0).status != ORACLE_COLLIDES) return rejected(&c->undecided);
  if (!march_out(rng, p, p->set->unit * draw(rng, p->set->march)))
    return rejected(&c->no_free_place);
  if (p->id % 2 == 0) {
    if (!touch(p, direction)) return rejected(&c->not_touching);
    return perturb(rng, p, direction, sigma, c);
  }
  oracle_sub(crossing.position, p->fixed_pose.position, direction);
  const double way = oracle_length(direction);
  for (int k = 0; k < 3; k++) direction[k] /= way;
  p->label = 1;
  p->margin = -depth(p, direction, way);
  p->fixed_pose = crossing;
  return p->margin < -UNDECIDED * p->set->unit || rejected(&c->undecided);
}

// --------------------------------------------------------------------------------- any of the sets

typedef struct pools {
  pool small;   // of the moving body
  pool large;   // of the fixed one, where it is of another family
  pool shells;  // cavities of `inside`
} pools;

typedef struct choice {
  source *small;
  source *large;
  double small_extent;
  double large_extent;
} choice;

static int uses_sigma(const set_info *set) {
  const placing how = set->placing;
  return how != CONTAINED && how != APART && how != ON_FLOOR && how != PARTLY_IN;
}
static int is_single_pose(const set_info *set, size_t id) {
  if (set->placing == ON_FLOOR) return plan_rest(id).single;
  return set->special == HALF_SINGLE && id % 2;
}
// Of ten problems, in how many the body of the second pool moves.
static int swapped_of_ten(const set_info *set) {
  if (set->placing == CONTAINED) return 3;
  return set->placing == PARTLY_IN || set->fixed_family == TRIANGLES ? 5 : 0;
}
// On a plate lies another plate, every other time. What is to be inside the floor needs a thick
// one, and is small enough to fit however it is turned.
static choice choose_for_rest(shapes_rng *rng, pools *from, const problem *p, choice chosen) {
  const rest_plan plan = plan_rest(p->id);
  while (plan.whole && chosen.large->floor.thickness < 0.01) chosen.large = any(rng, &from->large);
  if (chosen.large->floor.plate && shapes_pick(rng, 2)) {
    do chosen.small = any(rng, &from->large);
    while (!chosen.small->floor.plate);
  }
  if (plan.whole) {
    const double thickness =
        chosen.large->floor.thickness / chosen.large->extent * chosen.large_extent;
    chosen.small_extent = thickness * shapes_uniform(rng, 0.2, 0.6);
  }
  return chosen;
}
static void choose_bodies(shapes_rng *rng, pools *from, problem *p) {
  const set_info *set = p->set;
  const int tenths = swapped_of_ten(set);
  const int cavity = set->placing == CONTAINED && p->id % 2 == 0;
  choice chosen;
  p->swapped = tenths && shapes_pick(rng, 10) < tenths;
  chosen.small = any(rng, &from->small);
  chosen.large = any(rng, cavity ? &from->shells : set->fixed_family ? &from->large : &from->small);
  chosen.small_extent = set->unit * draw(rng, set->moving);
  chosen.large_extent = set->unit * draw(rng, set->fixed);
  if (set->placing == ON_FLOOR) chosen = choose_for_rest(rng, from, p, chosen);
  if (set->fixed_family == TRIANGLES && shapes_pick(rng, 3) == 0)
    chosen.small = any(rng, &from->large);
  if (set->placing == ALIKE) {
    chosen.large = chosen.small;
    chosen.large_extent = chosen.small_extent;
  }
  p->moving_source = p->swapped ? chosen.large : chosen.small;
  p->fixed_source = p->swapped ? chosen.small : chosen.large;
  p->moving_extent = p->swapped ? chosen.large_extent : chosen.small_extent;
  p->fixed_extent = p->swapped ? chosen.small_extent : chosen.large_extent;
}
static int attempt_any(shapes_rng *rng, problem *p, double sigma, counts *c) {
  switch (p->set->placing) {
    case CONTAINED:
      return attempt_inside(rng, p, (int)(p->id % 2), p->swapped, c);
    case APART:
      return attempt_far(rng, p, c);
    case ON_FLOOR:
      return attempt_rest(rng, p, c);
    case PARTLY_IN:
      return attempt_nested(rng, p, c);
    case ALIKE:
      return attempt_same(rng, p, sigma, c);
    default:
      return attempt(rng, p, sigma, c);
  }
}

// ------------------------------------------------------------------------------------------ output

static void write_pose(FILE *file, const oracle_pose *pose) {
  const double *p = pose->position;
  const double *q = pose->rotation;
  fprintf(file, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g", p[0], p[1], p[2], q[0], q[1], q[2], q[3]);
}
static void write_problem(FILE *file, const problem *p, size_t id) {
  source *sources[2];
  sources[0] = p->moving_source;
  sources[1] = p->fixed_source;
  for (int i = 0; i < 2; i++) {
    if (!sources[i]->used) fprintf(file, "mesh %s %s\n", sources[i]->name, sources[i]->path);
    sources[i]->used = 1;
  }
  fprintf(file, "problem %zu %s %.9g %s %.9g ", id, sources[0]->name, p->moving_scale,
          sources[1]->name, p->fixed_scale);
  write_pose(file, &p->fixed_pose);
  fprintf(file, " %d %.6g %zu\n", p->label, p->margin, p->samples);
  for (size_t s = 0; s < p->samples; s++) {
    write_pose(file, &p->motion[s]);
    fputc('\n', file);
  }
}
static void tally(counts *c, const problem *p) {
  static const double edges[5] = {1e-3, 2.5e-3, 5e-3, 10e-3, 20e-3};
  int bin = 0;
  while (bin < 5 && fabs(p->margin) > edges[bin] * p->set->unit) bin++;
  c->accepted[p->label]++;
  if (p->margin < 0 || p->margin > 0) c->histogram[p->label][bin]++;
}
static void print_summary(const set_info *set, const counts *c, double seconds) {
  printf("%zu problems: %zu collide, %zu free; %.1f s, %.1f ms each\n",
         c->accepted[0] + c->accepted[1], c->accepted[1], c->accepted[0], seconds,
         1e3 * seconds / (double)(c->accepted[0] + c->accepted[1]));
  printf(
      "%zu placements; rejected: %zu no free place, %zu not touching, %zu undecided, %zu for "
      "balance, %zu other\n",
      c->placed, c->no_free_place, c->not_touching, c->undecided, c->unbalanced, c->other);
  if (set->unit < 1 || set->unit > 1)
    printf("(below: divided by the unit of the set, %g m)\n", set->unit);
  printf("|margin| mm     0-1   1-2.5   2.5-5    5-10   10-20     >20\n");
  for (int label = 1; label >= 0; label--) {
    printf("%-9s", label ? "collide" : "free");
    for (int i = 0; i < 6; i++) printf(" %7zu", c->histogram[label][i]);
    printf("\n");
  }
}
// Sets that are what they are by their own meshes.
static int is_procedural_only(const set_info *set) {
  const family kind = set->moving_family;
  return kind == GROUPS || kind == NEEDLES || kind == SOUP;
}
static int usage(void) {
  fprintf(stderr,
          "problems --set SET --meshes DIR|procedural [--list FILE] [--open too|only] --count N "
          "--seed S\n"
          "         --out DIR/NAME.txt [--motion-samples M] [--sigma METRES] [--pool MESHES]\n"
          "  --list: use these file names of DIR only, one per line. --open: also, or only, meshes "
          "that are not closed.\n"
          "  --motion-samples, --sigma: other than the set's own, in brackets below.\n"
          "  --pool: how many procedural meshes to make (default: a tenth of N, 40 to 400).\n"
          "SET is one of (DIR replaces the meshes of the moving body, and of the fixed one where "
          "both are\n"
          "alike; not for nested, slivers and soup):\n");
  for (size_t i = 0; i < SETS; i++) {
    fprintf(stderr, "  %-9s %s [%zu", sets[i].name, sets[i].what, sets[i].samples);
    if (uses_sigma(&sets[i])) fprintf(stderr, ", %g", sets[i].sigma * sets[i].unit);
    fprintf(stderr, "]\n");
  }
  return 2;
}

int main(int argc, char **argv) {
  const char *set = NULL;
  const char *meshes = NULL;
  const char *list = NULL;
  const char *out = NULL;
  size_t count = 0;
  size_t samples = 0;
  size_t pool_size = 0;
  unsigned long long seed = 1;
  double sigma = 0;
  open_policy policy = CLOSED_ONLY;
  for (int i = 1; i + 1 < argc; i += 2) {
    const char *key = argv[i];
    const char *value = argv[i + 1];
    if (!strcmp(key, "--set"))
      set = value;
    else if (!strcmp(key, "--meshes"))
      meshes = value;
    else if (!strcmp(key, "--list"))
      list = value;
    else if (!strcmp(key, "--out"))
      out = value;
    else if (!strcmp(key, "--count"))
      count = (size_t)strtoul(value, NULL, 10);
    else if (!strcmp(key, "--seed"))
      seed = strtoull(value, NULL, 10);
    else if (!strcmp(key, "--sigma"))
      sigma = strtod(value, NULL);
    else if (!strcmp(key, "--pool"))
      pool_size = (size_t)strtoul(value, NULL, 10);
    else if (!strcmp(key, "--motion-samples"))
      samples = (size_t)strtoul(value, NULL, 10);
    else if (!strcmp(key, "--open"))
      policy = !strcmp(value, "only") ? OPEN_ONLY : OPEN_TOO;
    else
      return usage();
  }
  static problem p;
  for (size_t i = 0; set && i < SETS; i++)
    if (!strcmp(set, sets[i].name)) p.set = &sets[i];
  if (!samples && p.set) samples = p.set->samples;
  const int folder_given = meshes && strcmp(meshes, "procedural") != 0;
  if (folder_given && p.set && is_procedural_only(p.set)) return usage();
  if (argc % 2 == 0 || !p.set || !meshes || !out || !count || samples > MAX_SAMPLES) return usage();
  if (sigma <= 0) sigma = p.set->sigma * p.set->unit;
  int inside = p.set->placing == CONTAINED;

  clock_t begin = clock();
  shapes_rng rng = {seed};
  pools from;
  memset(&from, 0, sizeof from);
  char folder[PATH_MAX];
  snprintf(folder, sizeof folder, "%s", strrchr(out, '/') ? out : "./");
  *(strrchr(folder, '/') + 1) = 0;
  FILE *file = fopen(out, "w");
  if (!file) return fprintf(stderr, "%s: cannot be written\n", out), 1;
  if (!pool_size) pool_size = count / 10 < 40 ? 40 : count / 10 > 400 ? 400 : count / 10;
  if (strcmp(meshes, "procedural") != 0)
    load_folder(&from.small, meshes, list, policy, folder);
  else
    make_procedural(&from.small, &rng, p.set->moving_family, pool_size,
                    family_names[p.set->moving_family], out);
  size_t fixed_meshes = p.set->fixed_meshes;
  if (p.set->fixed_family == HOLLOWS && fixed_meshes > pool_size) fixed_meshes = pool_size;
  if (p.set->fixed_family)
    make_procedural(&from.large, &rng, p.set->fixed_family, fixed_meshes,
                    inside ? "large" : family_names[p.set->fixed_family], out);
  if (inside) make_procedural(&from.shells, &rng, SHELLS, 30, "shell", out);
  if (!from.small.count) return fprintf(stderr, "%s: no meshes\n", meshes), 1;

  fprintf(file,
          "nsvcd-problems 1\n# problems --set %s --meshes %s --count %zu --seed %llu "
          "--motion-samples %zu sigma %g\n",
          set, meshes, count, seed, samples, sigma);
  counts c;
  memset(&c, 0, sizeof c);
  for (size_t id = 0; id < count;) {
    int done = 0;
    p.id = id;
    p.samples = is_single_pose(p.set, id) ? 1 : samples;
    choose_bodies(&rng, &from, &p);
    if (!load_body(&p.moving, p.moving_source, p.moving_extent, &p.moving_scale)) return 1;
    if (!load_body(&p.fixed, p.fixed_source, p.fixed_extent, &p.fixed_scale)) return 1;
    for (int i = 0; i < p.set->tries && !done; i++) done = attempt_any(&rng, &p, sigma, &c);
    if (done) {
      tally(&c, &p);
      write_problem(file, &p, id++);
    }
    oracle_mesh_free(&p.moving);
    oracle_mesh_free(&p.fixed);
  }
  int ok = !ferror(file);
  if (fclose(file) != 0 || !ok) return fprintf(stderr, "%s: write error\n", out), 1;
  print_summary(p.set, &c, (double)(clock() - begin) / CLOCKS_PER_SEC);
  pool_free(&from.small);
  pool_free(&from.large);
  pool_free(&from.shells);
  return 0;
}
