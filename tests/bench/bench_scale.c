// bench_scale.c - what a scene costs before it is written: bytes, encoding and queries against
// triangles, from 12 to a million, and against N. Table on standard output, build/scale.svg.
//
//   build/bench_scale [TRIANGLES]    at most so many; 1,000,000
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include "meter.h"
#include "../level_scene.h"

#define MOTIONS 200
#define ROWS 40
#define LEVEL_SIDE 20.0

// ---- a row of the table

typedef enum kind { THING, LEVEL, BY_POINTS, KINDS } kind;
static const char *const kind_names[KINDS] = {"a thing of 0.3 m", "a level of 20 m",
                                              "that level, by N"};

typedef struct row {
  kind kind;
  size_t triangles, points, bytes, peak;
  double encode;  // milliseconds
  double query;   // microseconds, mean
} row;

// Motions of `mover` near the surface of `body`, as frames have them, whose mean counts: the
// shortest of three runs each.
static double mean_query(const level_solid *mover, const level_solid *body, int is_level) {
  shapes_rng rng = {9};
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(size);
  double sum = 0;
  for (int n = 0; n < MOTIONS;) {
    oracle_pose poses[2];
    if (is_level) {
      if (!level_motion(&rng, LEVEL_NEAR, mover, body, poses)) continue;
    } else {
      double direction[3], axis[3], spin[4];
      shapes_direction(&rng, direction);
      shapes_direction(&rng, axis);
      shapes_quaternion(&rng, poses[0].rotation);
      oracle_axis_angle(axis, 0.15, spin);
      oracle_quat_mul(spin, poses[0].rotation, poses[1].rotation);
      const double apart = body->radius + mover->radius + shapes_uniform(&rng, -0.15, 0.05);
      for (int k = 0; k < 3; k++) {
        poses[0].position[k] = apart * direction[k];
        poses[1].position[k] = poses[0].position[k] + 0.1 * axis[k];
      }
    }
    const nsvcd_pose stored[2] = {pose_rounded(&poses[0]), pose_rounded(&poses[1])};
    nsvcd_question question;
    nsvcd_answer answer;
    double best = 1e9;
    memset(&question, 0, sizeof question);
    question.a.body = mover->body;
    question.a.poses = stored;
    question.a.count = 2;
    question.b.body = body->body;
    for (int run = 0; run < 3; run++) {
      const double start = seconds();
      if (nsvcd_sweep(&question, workspace, size, &answer)) level_fail("a question was refused");
      best = fmin(best, 1e6 * (seconds() - start));
    }
    sum += best;
    n++;
  }
  free(workspace);
  return sum / MOTIONS;
}

static void make_shape(kind kind, size_t triangles, shapes_mesh *shape) {
  memset(shape, 0, sizeof *shape);
  if (kind != THING) {
    level_make(shape, LEVEL_SIDE, triangles, 1);
  } else if (triangles == 12) {
    shapes_box(shape, 0.3, 0.2, 0.1, 1);
  } else {
    level_boulder(shape, 0.15, (int)fmax(3, sqrt((double)triangles / 4)), 1);
  }
}

// points: 0 for the default; of a level, below that many triangles, patches half as large as what
// moves in it.
static row measure(kind kind, size_t triangles, size_t points, const level_solid *mover) {
  row out;
  level_solid solid;
  shapes_mesh shape;
  heap h = {0, 0};
  const nsvcd_allocator allocator = {heap_alloc, heap_free, &h};
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.patches = points;
  if (kind == LEVEL && triangles <= NSVCD_MANY_TRIANGLES) options.patch_radius = 0.15f;
  make_shape(kind, triangles, &shape);
  level_solid_init(&solid, &shape, kind == THING ? 0.3 : 0);
  const double start = seconds();
  if (nsvcd_encode(&solid.mesh, &options, &allocator, NULL, 0, &solid.body))
    level_fail("a body was refused");
  out.encode = 1e3 * (seconds() - start);
  const nsvcd_body_facts facts = nsvcd_body_describe(solid.body);
  out.kind = kind;
  out.triangles = solid.mesh.triangle_count;
  out.points = facts.patches;
  out.bytes = facts.size;
  out.peak = h.most;
  out.query = mean_query(mover, &solid, kind != THING);
  printf("%-18s %8zu %7zu %10.1f %8.1f %9.1f %8.1f %8.2f\n", kind_names[kind], out.triangles,
         out.points, 1e-3 * (double)out.bytes, (double)out.bytes / (double)out.triangles,
         (double)out.peak / (double)out.triangles, out.encode, out.query);
  fflush(stdout);
  nsvcd_body_free(solid.body, &allocator);
  solid.body = NULL;
  level_free(&solid);
  return out;
}

// ---- the picture: three panels, logarithmic both ways

#define PANEL_WIDTH 330.0
#define PANEL_HEIGHT 300.0

typedef struct panel {
  const char *title, *across;
  double low, high, least, most;  // decades of x, of y
  int by_points;
  int value;  // 0: bytes and peak, 1: encoding, 2: queries
} panel;

static double value_of(const row *r, int value) {
  return value == 0 ? (double)r->bytes : value == 1 ? r->encode : r->query;
}

static void draw_panel_of(FILE *svg, const panel *p, double left, const row *rows, size_t count) {
  static const char *const colours[KINDS] = {"#d55e00", "#0072b2", "#009e73"};
  const double top = 50;
  const double bottom = top + PANEL_HEIGHT;
  const double per_x = PANEL_WIDTH / (p->high - p->low);
  const double per_y = PANEL_HEIGHT / (p->most - p->least);
  fprintf(svg, "<text x='%.0f' y='34' font-size='16' font-weight='bold'>%s</text>\n", left,
          p->title);
  for (double d = ceil(p->low); d <= p->high; d++) {
    const double x = left + (d - p->low) * per_x;
    fprintf(svg,
            "<path d='M%.1f %.1fV%.1f' stroke='#ddd'/><text x='%.1f' y='%.1f' "
            "text-anchor='middle'>%g</text>\n",
            x, top, bottom, x, bottom + 18, pow(10, d));
  }
  for (double d = ceil(p->least); d <= p->most; d++) {
    const double y = bottom - (d - p->least) * per_y;
    fprintf(svg,
            "<path d='M%.1f %.1fH%.1f' stroke='#ddd'/><text x='%.1f' y='%.1f' "
            "text-anchor='end'>%g</text>\n",
            left, y, left + PANEL_WIDTH, left - 6, y + 5, pow(10, d));
  }
  fprintf(svg, "<text x='%.0f' y='%.0f' text-anchor='middle'>%s</text>\n", left + PANEL_WIDTH / 2,
          bottom + 40, p->across);
  for (int k = 0; k < KINDS; k++) {
    char letter = 'M';
    if ((k == BY_POINTS) != p->by_points) continue;
    fprintf(svg, "<path fill='none' stroke-width='3' stroke='%s' d='", colours[k]);
    for (size_t i = 0; i < count; i++) {
      if ((int)rows[i].kind != k) continue;
      const double at = log10((double)(p->by_points ? rows[i].points : rows[i].triangles));
      const double y = log10(value_of(&rows[i], p->value));
      fprintf(svg, "%c%.1f %.1f", letter, left + (at - p->low) * per_x,
              bottom - (y - p->least) * per_y);
      letter = 'L';
    }
    fprintf(svg, "'/>\n");
  }
}

static int draw(const char *path, const row *rows, size_t count) {
  static const panel panels[4] = {
      {"bytes of a body", "triangles", 1, 6, 3, 8, 0, 0},
      {"encoding, milliseconds", "triangles", 1, 6, 0, 4, 0, 1},
      {"a query, microseconds", "triangles", 1, 6, 0, 2, 0, 2},
      {"a query, microseconds", "N, of the level of 200,000", 2, 5, 0, 3, 1, 2}};
  FILE *svg = fopen(path, "w");
  if (!svg) return 0;
  fprintf(svg,
          "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1660 430' font-family='sans-serif' "
          "font-size='13'>\n"
          "<rect width='100%%' height='100%%' fill='white'/>\n");
  for (size_t k = 0; k < 4; k++)
    draw_panel_of(svg, &panels[k], 70 + 405.0 * (double)k, rows, count);
  fprintf(svg,
          "<g font-size='15'><text x='70' y='420' fill='#d55e00'>a thing of 0.3 m</text>"
          "<text x='240' y='420' fill='#0072b2'>a level of 20 m</text></g>\n</svg>\n");
  const int good = !ferror(svg);
  return fclose(svg) == 0 && good;
}

int main(int argc, char **argv) {
  static const size_t sizes[10] = {12, 100, 300, 1000, 3000, 10000, 30000, 100000, 300000, 1000000};
  static const size_t points[8] = {192, 512, 2000, 4000, 8000, 16000, 32000, 65536};
  const size_t most = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000000;
  static row rows[ROWS];
  static level_solid bodies[LEVEL_BODIES];
  size_t count = 0;
  level_make_bodies(bodies);
  printf("%-18s %8s %7s %10s %8s %9s %8s %8s\n", "", "T", "N", "KB", "bytes/T", "peak/T", "encode",
         "query");
  printf("%-18s %8s %7s %10s %8s %9s %8s %8s\n", "", "", "", "", "", "", "ms", "us");
  for (int k = 0; k < 10; k++) {
    if (sizes[k] <= most) rows[count++] = measure(THING, sizes[k], 0, &bodies[2]);
  }
  for (int k = 4; k < 10; k++) {
    if (sizes[k] <= most) rows[count++] = measure(LEVEL, sizes[k], 0, &bodies[2]);
  }
  for (int k = 0; k < 8 && most >= 200000; k++)
    rows[count++] = measure(BY_POINTS, 200000, points[k], &bodies[2]);
  return draw("build/scale.svg", rows, count) ? 0 : 1;
}
