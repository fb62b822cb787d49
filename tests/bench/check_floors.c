// check_floors.c - floors and extremes: in what range is everything decided, and right? Bodies over
// a large floor, held against the lowest of their vertices in double (tests/floor_scene.h). Prints
// two tables; ends with 1 if an answer is wrong, or if one of the first table's is left open.
//
//   build/check_floors [COUNT [FILE.obj ...]]   COUNT questions a floor; props beside its own
#define _POSIX_C_SOURCE 200112L
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../floor_scene.h"

#define MOST_PROPS 64
#define OWN_PROPS 4
#define MOST_POSES 65536

static floor_prop props[MOST_PROPS];
static int prop_count;
static void *workspace;
static size_t workspace_size;
static size_t faults;

static void add_own_props(void) {
  shapes_mesh shapes[OWN_PROPS];
  memset(shapes, 0, sizeof shapes);
  shapes_box(&shapes[0], 0.5, 0.4, 0.3, 1);
  shapes_mug(&shapes[1], 0.04, 0.1, 0.004, 24);
  shapes_chair(&shapes[2], 0.5, 0.9, 0.04);
  shapes_cone(&shapes[3], 0.2, 0.1, 0.3, 24);
  for (int n = 0; n < OWN_PROPS; n++) props[prop_count++] = floor_prop_of_shape(&shapes[n]);
}
static void add_file(const char *path) {
  nsvcd_mesh mesh;
  if (prop_count == MOST_PROPS || nsvcd_obj_load(path, NULL, &mesh, NULL)) return;
  props[prop_count] = floor_prop_of(&mesh);
  prop_count += props[prop_count].body != NULL;
  nsvcd_mesh_free(&mesh, NULL);
}

// -------------------------------------------------------------------------------------------------
// floors

static void check_floor(double half, int cells, double aside, double away, size_t count) {
  const floor_prop floor = floor_of(half, cells, 1, aside);
  floor_tally sum;
  shapes_rng rng = {46};
  memset(&sum, 0, sizeof sum);
  for (size_t i = 0; i < count; i++) {
    floor_scene s = floor_under(&floor, &props[shapes_pick(&rng, prop_count)], half, aside, away);
    floor_draw(&s, &rng, i);
    floor_ask(&s, workspace, workspace_size, 3, &sum);
  }
  faults += sum.wrong + sum.open;
  printf("| %g m | %d | %g m | %g m | %zu | %zu | %zu | %zu | %.2g m |\n", 2 * half,
         cells ? 12 * cells * cells : 1, aside, away, sum.asked, sum.asked - sum.wrong - sum.open,
         sum.open, sum.wrong, sum.first);
  nsvcd_body_free(floor.body, NULL);
  free(floor.vertices);
}

static void check_floors(size_t count) {
  static const double halves[3] = {10, 100, 1000};
  static const int cells[5] = {0, 1, 3, 29, 289};
  printf("| floor | triangles | from its own origin | from the world's | asked | right | open |");
  printf(" wrong | contact off by |\n|---|---|---|---|---|---|---|---|---|\n");
  for (int n = 0; n < 5; n++)
    for (int k = 0; k < 3; k++) check_floor(halves[k], cells[n], 0, 0, count);
  for (int k = 0; k < 2; k++) {
    check_floor(100, 1, k ? 1e5 : 1e3, 0, count);
    check_floor(100, 1, 0, k ? 1e5 : 1e3, count);
  }
}

// -------------------------------------------------------------------------------------------------
// extremes

enum { SIZE, RATIO, AWAY, WAY, POSES, TURNS, CLEARANCE, SLIVER, EXTREMES };
static const struct {
  const char *name, *unit;
  double from, by;
  int steps, count;
} extremes[EXTREMES] = {{"size of both", "m", 1e-13, 10, 20, 40},
                        {"the floor beside the body", "times", 1, 10, 8, 40},
                        {"both from the world's origin", "m", 1e-1, 10, 8, 40},
                        {"a straight way", "sizes", 1e-3, 10, 10, 40},
                        {"poses", "", 2, 8, 6, 4},
                        {"turns", "", 0.25, 8, 6, 4},
                        {"clearance", "of the body", 1e-6, 10, 12, 40},
                        {"thinner than long: a needle", "times", 1, 10, 9, 40}};

// Many poses at one height, aside or turned in between: how near it comes is what it is at the start.
static void along_many(floor_scene *s, shapes_rng *rng, size_t count, int turns) {
  static nsvcd_pose poses[MOST_POSES];
  for (size_t i = 0; i < count; i++) {
    const double half_angle = turns ? 0.7 * (double)i : 0;
    poses[i] = s->poses[0];
    for (int k = 0; k < 2 && !turns; k++)
      poses[i].position[k] = pose_to_float(s->half * shapes_uniform(rng, -0.4, 0.4));
    poses[i].rotation[2] = pose_to_float(sin(half_angle));
    poses[i].rotation[3] = pose_to_float(cos(half_angle));
  }
  s->question.a.poses = poses;
  s->question.a.count = count;
  s->nearest = floor_height(s, 0);
}

typedef struct trial {
  floor_prop floor, prop;
  floor_scene base;
  size_t poses;
  int turns;
} trial;

// What is asked where one property is `value`; all else is ordinary.
static trial trial_of(int what, double value) {
  trial out;
  shapes_mesh box;
  double size = what == SIZE ? value : 1;
  const double thin = what == SLIVER ? value : 1;
  memset(&out, 0, sizeof out);
  memset(&box, 0, sizeof box);
  if (what == RATIO) size = fmin(1, 1e5 / value);
  out.base.half = size * (what == RATIO ? value : what == WAY ? fmax(10, 3 * value) : 10);
  out.base.way = what == WAY ? value : 1;
  out.base.scale = 1;
  if (what == AWAY) out.base.origin[0] = out.base.origin[1] = value;
  if (what == CLEARANCE) out.base.clearance = (double)(float)(value * size);
  if (what == POSES) out.poses = (size_t)value;
  if (what == TURNS) out.poses = 1 + (size_t)(value * 4.5);
  out.turns = what == TURNS;
  shapes_box(&box, size, size / thin, size / thin, 1);
  out.prop = floor_prop_of_shape(&box);
  out.floor = floor_of(out.base.half, 1, size, 0);
  return out;
}

// All right and decided, where the gap is so much of the size? -1: refused, 0: not all.
static int passes(const trial *of, double gap, size_t count, floor_tally *sum) {
  static const floor_act acts[5] = {FLOOR_RESTS, FLOOR_SLIDES, FLOOR_TURNS, FLOOR_TUMBLES,
                                    FLOOR_COMES};
  shapes_rng rng = {47};
  const floor_tally before = *sum;
  if (!of->prop.body || !of->floor.body) return -1;
  for (size_t i = 0; i < count; i++) {
    floor_scene s = of->base;
    s.floor = &of->floor;
    s.prop = &of->prop;
    s.act = of->poses ? FLOOR_SLIDES : acts[i % 5];
    s.gap = s.clearance + gap * of->prop.radius * (i / 5 % 2 ? 1 : -1);
    floor_make(&s, &rng);
    if (of->poses) along_many(&s, &rng, of->poses, of->turns);
    nsvcd_answer answer;
    if (nsvcd_sweep(&s.question, workspace, workspace_size, &answer)) return -1;
    floor_ask(&s, workspace, workspace_size, 0, sum);
  }
  return sum->wrong == before.wrong && sum->open == before.open;
}

// A row: the values at which gaps of a thousandth of the size are decided, and the least gap that is.
static void check_extreme(int what) {
  double from = 0;
  double to = 0;
  double least = 0;
  char outside[200] = "";
  floor_tally sum;
  memset(&sum, 0, sizeof sum);
  for (int n = 0; n < extremes[what].steps; n++) {
    const double value = extremes[what].from * pow(extremes[what].by, n);
    trial of = trial_of(what, value);
    const size_t count = (size_t)extremes[what].count;
    double gap = 1e-3;
    const int passed = passes(&of, gap, count, &sum);
    if (passed == 1) {
      while (gap > 1e-12 && passes(&of, 0.1 * gap, count, &sum) == 1) gap *= 0.1;
      from = from > 0 ? from : value;
      to = value;
      least = fmax(least, gap);
    } else if (strlen(outside) < 150) {
      snprintf(outside + strlen(outside), 50, "%s%.3g %s", *outside ? ", " : "", value,
               passed < 0 ? "refused" : "open");
    }
    floor_prop_free(&of.prop);
    floor_prop_free(&of.floor);
  }
  faults += sum.wrong;
  printf("| %s | %.3g to %.3g %s | %.0e | %s | %zu of %zu |\n", extremes[what].name, from, to,
         extremes[what].unit, least, *outside ? outside : "all that was tried is decided",
         sum.wrong, sum.asked);
}

int main(int argc, char **argv) {
  const size_t count = argc > 1 ? (size_t)atoi(argv[1]) : 100;
  workspace_size = nsvcd_sweep_workspace_size(NULL);
  workspace = malloc(workspace_size);
  if (!workspace || count == 0) return 2;
  add_own_props();
  for (int i = 2; i < argc; i++) add_file(argv[i]);
  printf("%d props\n\n", prop_count);
  check_floors(count);
  printf("\n| what varies | everything decided | gaps down to, of the body | outside | wrong |\n");
  printf("|---|---|---|---|---|\n");
  for (int n = 0; n < EXTREMES; n++) check_extreme(n);
  for (int n = 0; n < prop_count; n++) floor_prop_free(&props[n]);
  free(workspace);
  return faults > 0;
}
