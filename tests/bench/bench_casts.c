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
#include "../body_of.h"
#include "meter.h"

#define SIDE 20.0
#define CASTS 2000
#define RUNS 5
#define POINTS 200000

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
  meter_sort(least, CASTS);
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
  const size_t left = points[2] == 0 ? POINTS : 0;  // they are made once
  for (size_t i = 0; i < left; i++) {               // of a surface, as a camera sees it
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

// ---- a map that changes: cells of 5 cm through which the ground goes, in chunks of 16 x 16 x 16, each
// a body of its own. A cell that changes costs its chunk. A question is asked of the chunks near.
#define CELL 0.05
#define HALF_DIAGONAL 0.0434  // of a cell, or more
#define CHUNKS 10             // along x and y; along z there are two
#define ALL_CHUNKS (2 * CHUNKS * CHUNKS)
#define MOST_CELLS (4 * 256 * CHUNKS * CHUNKS)

// The cells of the chunks from corner to corner - 1, as balls that hold them.
static const nsvcd_body *encode_chunks(const int *first, const int *end, double *taken) {
  static float points[3 * MOST_CELLS];
  const nsvcd_body *body = NULL;
  size_t count = 0;
  for (int i = 16 * first[0]; i < 16 * end[0]; i++) {
    for (int j = 16 * first[1]; j < 16 * end[1]; j++) {
      double low = 1;
      double high = -1;
      for (int corner = 0; corner < 4; corner++) {
        const double z = level_height((i + corner % 2) * CELL, (j + corner / 2) * CELL);
        low = fmin(low, z);
        high = fmax(high, z);
      }
      for (int k = (int)floor(low / CELL); k <= (int)floor(high / CELL); k++) {
        if (k < 16 * first[2] || k >= 16 * end[2]) continue;
        if (count == MOST_CELLS) exit(1);
        points[3 * count] = (float)((i + 0.5) * CELL);
        points[3 * count + 1] = (float)((j + 0.5) * CELL);
        points[3 * count++ + 2] = (float)((k + 0.5) * CELL);
      }
    }
  }
  if (count == 0) return NULL;
  *taken = 1e9;
  for (int run = 0; run < RUNS; run++) {
    nsvcd_body_free(body, NULL);
    const double start = seconds();
    if (nsvcd_encode_cloud(points, count, (float)HALF_DIAGONAL, NULL, &body)) exit(1);
    *taken = fmin(*taken, 1e6 * (seconds() - start));
  }
  return body;
}

static void chunk_at(int n, int *at) {
  at[0] = n % CHUNKS - CHUNKS / 2;
  at[1] = n / CHUNKS % CHUNKS - CHUNKS / 2;
  at[2] = n / CHUNKS / CHUNKS - 1;
}

// The question, asked of each chunk whose box the path of a sphere of 0.1 m comes near. Returns how
// many.
static size_t ask_near(const nsvcd_question *question, const nsvcd_body **chunks,
                       nsvcd_question *asked) {
  const nsvcd_pose *path = question->a.poses;
  const double reach = 0.05 + HALF_DIAGONAL;
  size_t count = 0;
  for (int n = 0; n < ALL_CHUNKS; n++) {
    int at[3];
    int is_near = chunks[n] != NULL;
    chunk_at(n, at);
    for (int k = 0; k < 3; k++) {
      const double low = fmin(path[0].position[k], path[1].position[k]) - reach;
      const double high = fmax(path[0].position[k], path[1].position[k]) + reach;
      is_near &= low <= 16 * CELL * (at[k] + 1) && high >= 16 * CELL * at[k];
    }
    if (!is_near) continue;
    asked[count] = *question;
    asked[count++].b.body = chunks[n];
  }
  return count;
}

// A sphere flies: to the map as one body, and to the chunks near, in one call.
static void print_flights(const nsvcd_body *sphere, const nsvcd_body *whole,
                          const nsvcd_body **chunks, void *workspace) {
  static nsvcd_question asked[ALL_CHUNKS];
  static nsvcd_answer answers[ALL_CHUNKS];
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  shapes_rng rng = {9};
  double sums[2] = {0, 0};
  size_t near_count = 0;
  size_t differ = 0;
  for (size_t count = 0; count < CASTS; count++) {
    nsvcd_question q;
    nsvcd_pose path[2];
    double way[3];
    double least[2] = {1e9, 1e9};
    size_t n = 0;
    int hit = 0;
    const double length = shapes_uniform(&rng, 0.1, 1);
    const double x = shapes_uniform(&rng, -3, 3);
    const double y = shapes_uniform(&rng, -3, 3);
    shapes_direction(&rng, way);
    memset(&q, 0, sizeof q);
    memset(path, 0, sizeof path);
    for (int k = 0; k < 2; k++) {
      path[k].position[0] = (float)(x + k * length * way[0]);
      path[k].position[1] = (float)(y + k * length * way[1]);
      path[k].position[2] = (float)(level_height(x, y) + 0.2 + 0.5 * k * length * way[2]);
      path[k].rotation[3] = 1;
    }
    q.a.body = sphere;
    q.a.poses = path;
    q.a.count = 2;
    q.b.body = whole;
    q.ask = NSVCD_ASK_FIRST;
    q.to = 1e-3f;
    for (int run = 0; run < 2 * RUNS; run++) {
      const double start = seconds();
      if (run % 2) n = ask_near(&q, chunks, asked);
      if (nsvcd_sweep_batch(run % 2 ? asked : &q, run % 2 ? n : 1, workspace, size, answers))
        exit(1);
      least[run % 2] = fmin(least[run % 2], 1e6 * (seconds() - start));
      if (run == 0) hit = answers[0].verdict == NSVCD_HIT;
    }
    near_count += n;
    int near_hit = 0;
    while (n > 0) near_hit |= answers[--n].verdict == NSVCD_HIT;
    differ += near_hit != hit;
    for (int k = 0; k < 2; k++) sums[k] += least[k] / CASTS;
  }
  printf(
      "  a sphere flies 0.1 to 1 m: mean %.2f us; to the %.1f chunks near %.2f us; %zu verdicts "
      "differ\n",
      sums[0], (double)near_count / CASTS, sums[1], differ);
}

static void print_map(const nsvcd_body *sphere, void *workspace) {
  static const int corner[3] = {-CHUNKS / 2, -CHUNKS / 2, -1};
  static const int opposite[3] = {CHUNKS / 2, CHUNKS / 2, 1};
  static const nsvcd_body *chunks[ALL_CHUNKS];
  double whole_us = 0;
  double sum = 0;
  double worst = 0;
  size_t bodies = 0;
  const nsvcd_body *whole = encode_chunks(corner, opposite, &whole_us);
  for (int n = 0; n < ALL_CHUNKS; n++) {
    int first[3];
    double taken = 0;
    chunk_at(n, first);
    const int end[3] = {first[0] + 1, first[1] + 1, first[2] + 1};
    chunks[n] = encode_chunks(first, end, &taken);
    bodies += chunks[n] != NULL;
    sum += taken;
    worst = fmax(worst, taken);
  }
  printf("a map of %zu cells: %.2f ms to encode; one of its %zu chunks: mean %.0f, worst %.0f us\n",
         nsvcd_body_describe(whole).triangles, 1e-3 * whole_us, bodies, sum / (double)bodies,
         worst);
  print_flights(sphere, whole, chunks, workspace);
  for (int n = 0; n < ALL_CHUNKS; n++) nsvcd_body_free(chunks[n], NULL);
  nsvcd_body_free(whole, NULL);
}

int main(int argc, char **argv) {
  static const float ends[2][3] = {{0, 0, -0.6f}, {0, 0, 0.6f}};
  const size_t triangles = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 139080;
  const nsvcd_body *cloud = NULL;
  const nsvcd_body *box = NULL;
  void *workspace = allocate(nsvcd_sweep_workspace_size(NULL));
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  level_make(&shape, SIDE, triangles, 1);
  const nsvcd_body *level = body_of(&shape, NULL);
  cast casts[3] = {{"capsule of 1.8 m, 1 to 10 cm", NULL, 0.01, 0.1, 1e-3f, 0.002f},
                   {"sphere of 0.1 m, 0.1 to 1 m", NULL, 0.1, 1, 1e-3f, 0},
                   {"ray of 1 mm, 2 to 20 m", NULL, 2, 20, 1e-3f, 0}};
  if (nsvcd_encode_capsule(ends[0], ends[1], 0.3f, NULL, &casts[0].body) ||
      nsvcd_encode_sphere(0.05f, NULL, &casts[1].body) ||
      nsvcd_encode_sphere(5e-4f, NULL, &casts[2].body))
    return complain("encoding"), REFUSED;
  printf("a level of %zu triangles, %zu patches; first contacts to 1 mm\n", shape.triangles,
         nsvcd_body_describe(level).patches);
  for (int k = 0; k < 3; k++) print_cast(&casts[k], level, workspace);
  print_map(casts[1].body, workspace);
  for (int k = 0; k < 3; k++) nsvcd_body_free(casts[k].body, NULL);
  const double cloud_ms = encode_ms(encode_cloud, &cloud);
  const double box_ms = encode_ms(encode_box, &box);
  printf("encoding %d points: %.1f ms, %.2f MB; a box: %.3f ms, %zu bytes\n", POINTS, cloud_ms,
         1e-6 * (double)nsvcd_body_describe(cloud).size, box_ms, nsvcd_body_describe(box).size);
  nsvcd_body_free(cloud, NULL);
  nsvcd_body_free(box, NULL);
  nsvcd_body_free(level, NULL);
  shapes_free(&shape);
  free(workspace);
  return DONE;
}
