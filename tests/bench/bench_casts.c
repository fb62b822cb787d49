// bench_casts.c - what round bodies cost a game: a capsule that walks, a sphere that is thrown and a
// ray, each to its first contact in a level, and how long encoding takes.
//
//   build/bench_casts [TRIANGLES]    of the level; 139,080 if not given
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
#define PROGRAM "bench_casts"
#include "../../examples/scenery/problem_file.h"
#include "../../examples/scenery/level.h"

#define SIDE 20.0
#define CASTS 2000
#define RUNS 5
#define POINTS 200000

static int compare_doubles(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}

typedef struct cast {
  const char *name;
  const nsvcd_body *body;
  double least_way, most_way;  // metres
  float to, clearance;
} cast;

static void print_cast(const cast *c, const nsvcd_body *level, void *workspace) {
  static double least[CASTS];
  shapes_rng rng = {7};
  double sum = 0;
  size_t count = 0;
  size_t hits = 0;
  size_t undecided = 0;
  while (count < CASTS) {
    nsvcd_question q;
    nsvcd_answer answer;
    nsvcd_pose path[2];
    double way[3];
    const double x = shapes_uniform(&rng, -9, 9);
    const double y = shapes_uniform(&rng, -9, 9);
    const double z = level_height(x, y) + shapes_uniform(&rng, 0, 0.1) +
                     (double)nsvcd_body_describe(c->body).radius;
    const double length = shapes_uniform(&rng, c->least_way, c->most_way);
    shapes_direction(&rng, way);
    memset(&q, 0, sizeof q);
    memset(path, 0, sizeof path);
    for (int k = 0; k < 2; k++) {
      path[k].position[0] = (float)(x + k * length * way[0]);
      path[k].position[1] = (float)(y + k * length * way[1]);
      path[k].position[2] = (float)(z + k * 0.5 * length * way[2]);
      path[k].rotation[3] = 1;
    }
    q.a.body = c->body;
    q.a.poses = path;
    q.b.body = level;
    q.a.count = 1;
    q.clearance = c->clearance;
    if (nsvcd_sweep(&q, workspace, nsvcd_sweep_workspace_size(NULL), &answer)) exit(1);
    if (answer.verdict != NSVCD_FREE) continue;
    q.a.count = 2;
    q.ask = NSVCD_ASK_FIRST;
    q.to = c->to;
    for (int run = 0; run < RUNS; run++) {
      const double start = seconds();
      if (nsvcd_sweep(&q, workspace, nsvcd_sweep_workspace_size(NULL), &answer)) exit(1);
      const double taken = 1e6 * (seconds() - start);
      least[count] = run == 0 ? taken : fmin(least[count], taken);
    }
    hits += answer.verdict == NSVCD_HIT;
    undecided += answer.verdict == NSVCD_UNDECIDED;
    sum += least[count++];
  }
  qsort(least, CASTS, sizeof *least, compare_doubles);
  printf(
      "  %-34s median %5.2f  mean %5.2f  99 %% %6.1f  worst %6.1f us;  %4.1f %% hit, %zu "
      "undecided\n",
      c->name, least[CASTS / 2], sum / CASTS, least[CASTS * 99 / 100], least[CASTS - 1],
      100.0 * (double)hits / CASTS, undecided);
}

static double encode_ms(nsvcd_result (*encode)(const nsvcd_body **), const nsvcd_body **body) {
  double best = 1e9;
  for (int run = 0; run < RUNS; run++) {
    if (run) nsvcd_body_free(*body, NULL);
    const double start = seconds();
    if (encode(body)) exit(1);
    best = fmin(best, 1e3 * (seconds() - start));
  }
  return best;
}
static nsvcd_result encode_cloud(const nsvcd_body **body) {
  static float points[3 * POINTS];
  shapes_rng rng = {3};
  for (size_t i = 0; i < POINTS; i++) {  // of a surface, as a camera sees it
    const double x = shapes_uniform(&rng, -4, 4);
    const double y = shapes_uniform(&rng, -4, 4);
    points[3 * i] = (float)x;
    points[3 * i + 1] = (float)y;
    points[3 * i + 2] = (float)level_height(x, y);
  }
  return nsvcd_encode_cloud(points, POINTS, 0.01f, NULL, body);
}
static nsvcd_result encode_box(const nsvcd_body **body) {
  const float half[3] = {0.5f, 0.5f, 0.5f};
  return nsvcd_encode_box(half, 0, NULL, body);
}

int main(int argc, char **argv) {
  static const float ends[2][3] = {{0, 0, -0.6f}, {0, 0, 0.6f}};
  const size_t triangles = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 139080;
  const nsvcd_body *level = NULL;
  const nsvcd_body *cloud = NULL;
  const nsvcd_body *box = NULL;
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  level_make(&shape, SIDE, triangles, 1);
  float *positions = (float *)allocate(3 * shape.vertices * sizeof(float));
  for (size_t i = 0; i < 3 * shape.vertices; i++) positions[i] = (float)shape.positions[i];
  const nsvcd_mesh mesh = {positions, shape.indices, shape.vertices, shape.triangles};
  if (nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &level)) return complain("encoding"), REFUSED;
  cast casts[3] = {{"capsule of 1.8 m, 1 to 10 cm", NULL, 0.01, 0.1, 1e-3f, 0.002f},
                   {"sphere of 0.1 m, 0.1 to 1 m", NULL, 0.1, 1, 1e-3f, 0},
                   {"ray of 1 mm, 2 to 20 m", NULL, 2, 20, 1e-3f, 0}};
  if (nsvcd_encode_capsule(ends[0], ends[1], 0.3f, NULL, &casts[0].body) ||
      nsvcd_encode_sphere(0.05f, NULL, &casts[1].body) ||
      nsvcd_encode_sphere(5e-4f, NULL, &casts[2].body))
    return complain("encoding"), REFUSED;
  printf("a level of %zu triangles, %zu patches; first contacts to 1 mm\n", shape.triangles,
         nsvcd_body_describe(level).patches);
  for (int k = 0; k < 3; k++) {
    print_cast(&casts[k], level, workspace);
    nsvcd_body_free(casts[k].body, NULL);
  }
  const double cloud_ms = encode_ms(encode_cloud, &cloud);
  const double box_ms = encode_ms(encode_box, &box);
  printf("encoding %d points: %.1f ms, %.2f MB; a box: %.3f ms, %zu bytes\n", POINTS, cloud_ms,
         1e-6 * (double)nsvcd_body_describe(cloud).size, box_ms, nsvcd_body_describe(box).size);
  nsvcd_body_free(cloud, NULL);
  nsvcd_body_free(box, NULL);
  nsvcd_body_free(level, NULL);
  shapes_free(&shape);
  free(positions);
  free(workspace);
  return DONE;
}
