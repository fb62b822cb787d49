// bench_level.c - a level as one body: what it takes to encode, and what the motions of a frame
// against it cost beside the same question about its local piece, that which the motion can reach,
// cut out and encoded by itself. Every verdict is held against the oracle.
//
//   build/bench_level TRIANGLES [MOTIONS [POINTS]]    a level of 20 m; N: 0, the default, or
//                                                     patches of 0.15 m
//   build/bench_level TRIANGLES MOTIONS POINTS network    the same by the network, whose errors are
//                                                         counted
//   build/bench_level encode [RUNS]    microseconds a triangle to encode levels, chunks cut out of
//                                      one, and props: median and least of RUNS
//
// Sets: `near`, at random places and in all directions, half of them hits or so; `slide`, along the
// ground at some tenths of a millimetre to some millimetres; `dash`, ten frames' way in one. Exit
// status 1 if a proof is wrong.
#define _POSIX_C_SOURCE 200112L
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include <stdio.h>
#include <stdlib.h>

#include "meter.h"
#include "../level_scene.h"
#include "../../examples/scenery/status_of.h"

#define SIDE 20.0  // metres
// metres, of patches, where there are fewer triangles than the library takes for a level's
#define RADIUS 0.15f
#define RUNS 5       // times that each question is asked; the shortest counts
#define MARGIN 1e-4  // metres: nearer to contact than this the oracle's label is not counted

static const char *const set_names[LEVEL_SETS] = {"near", "slide", "dash"};

// ---- the comparison

static double microseconds(const nsvcd_question *question, void *workspace, size_t size,
                           nsvcd_answer *answer) {
  double best = 1e9;
  for (int run = 0; run < RUNS; run++) {
    const double start = seconds();
    if (nsvcd_sweep(question, workspace, size, answer)) level_fail("a question was refused");
    best = fmin(best, 1e6 * (seconds() - start));
  }
  return best;
}

static double print_times(const char *name, double *times, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; i++) sum += times[i];
  meter_sort(times, count);
  printf("    %-6s median %6.1f  mean %6.1f  99 %% %7.1f us\n", name, times[count / 2],
         sum / (double)count, times[count * 99 / 100]);
  return sum / (double)count;
}

// One set of motions. Returns how many verdicts are wrong.
static size_t run_set(int set, size_t motions, const level_solid *bodies, const level_solid *level,
                      nsvcd_method method, void *workspace, size_t size) {
  shapes_rng rng = {(uint64_t)(100 + set)};
  double *times[2];
  size_t hits = 0;
  size_t free_of = 0;
  size_t wrong = 0;
  size_t piece_wrong = 0;
  size_t undecided = 0;
  size_t differ = 0;
  size_t close_calls = 0;
  size_t count = 0;
  for (int k = 0; k < 2; k++) times[k] = (double *)malloc((motions + 1) * sizeof(double));
  if (!times[0] || !times[1]) level_fail("no memory");
  while (count < motions) {
    const level_way way = level_draw(&rng, set, bodies, level);
    const nsvcd_body *piece = level_piece(level, way.body, way.stored);
    if (!piece) continue;
    const oracle_result label = level_label(&way, level);
    nsvcd_question question;
    nsvcd_answer whole, local;
    memset(&question, 0, sizeof question);
    question.a.body = way.body->body;
    question.a.poses = way.stored;
    question.a.count = 2;
    question.b.body = level->body;
    question.method = method;
    times[0][count] = microseconds(&question, workspace, size, &whole);
    question.b.body = piece;
    times[1][count] = microseconds(&question, workspace, size, &local);
    nsvcd_body_free(piece, NULL);
    count++;

    undecided += whole.verdict == NSVCD_UNDECIDED;
    differ += collides_of(&whole) != collides_of(&local) && label.status != ORACLE_INSIDE;
    if (label.status == ORACLE_FREE && label.distance < MARGIN) {
      close_calls++;
      continue;
    }
    const int collides = label.status == ORACLE_COLLIDES || label.status == ORACLE_INSIDE;
    hits += collides != 0;
    free_of += !collides;
    if (whole.verdict != NSVCD_UNDECIDED) wrong += collides_of(&whole) != collides;
    // A part of a level encloses nothing.
    if (label.status != ORACLE_INSIDE)
      piece_wrong += local.verdict != NSVCD_UNDECIDED && collides_of(&local) != collides;
  }
  printf(
      "  %s: %zu hits, %zu free, %zu within %g mm of contact; %zu wrong (the piece: %zu), %zu "
      "undecided, %zu unlike the piece\n",
      set_names[set], hits, free_of, close_calls, 1e3 * MARGIN, wrong, piece_wrong, undecided,
      differ);
  const double whole = print_times("level", times[0], count);
  const double local = print_times("piece", times[1], count);
  printf("    x %.2f\n", whole / local);
  free(times[0]);
  free(times[1]);
  return wrong;
}

// ---- encoding

#define CHUNK_LEVEL 139080  // triangles of the level that chunks are cut out of

// Encodes a mesh. patches: 0: the default. The last column tells one body from another.
static void print_encoding(const char *name, const nsvcd_mesh *mesh, size_t patches, size_t runs) {
  nsvcd_encode_options options;
  double *times = (double *)malloc(runs * sizeof *times);
  const double per = 1 / (double)mesh->triangle_count;
  nsvcd_body_facts facts = nsvcd_body_describe(NULL);
  uint32_t hash = 2166136261u;
  if (!times) level_fail("no memory");
  memset(&options, 0, sizeof options);
  options.patches = patches;
  for (size_t run = 0; run < runs; run++) {
    const nsvcd_body *body;
    const double start = seconds();
    if (nsvcd_encode(mesh, &options, NULL, NULL, 0, &body)) level_fail("a mesh was refused");
    times[run] = 1e6 * per * (seconds() - start);
    facts = nsvcd_body_describe(body);
    for (size_t i = 0; run == 0 && i < facts.size; i++)
      hash = (hash ^ ((const unsigned char *)body)[i]) * 16777619u;
    nsvcd_body_free(body, NULL);
  }
  meter_sort(times, runs);
  printf(
      "%-8s %7zu triangles %6zu patches  median %6.2f, least %6.2f us a triangle  %6.2f ms  %6.1f "
      "bytes  %08x\n",
      name, mesh->triangle_count, facts.patches, times[runs / 2], times[0],
      1e-3 * times[runs / 2] / per, (double)facts.size * per, (unsigned)hash);
  free(times);
}

static void print_shape(const char *name, shapes_mesh *shape, size_t runs) {
  nsvcd_mesh mesh = mesh_of(shape);
  print_encoding(name, &mesh, 0, runs);
  nsvcd_mesh_free(&mesh, NULL);
  shapes_free(shape);
}

static int print_encodings(size_t runs) {
  static const size_t levels[4] = {1000, 5000, 20000, CHUNK_LEVEL};
  // metres, of chunks
  static const double sides[3] = {1.5, 4, 8};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  for (int k = 0; k < 4; k++) {
    level_make(&shape, SIDE, levels[k], 1);
    print_shape("level", &shape, runs);
  }
  level_make(&shape, SIDE, CHUNK_LEVEL, 1);
  nsvcd_mesh level = mesh_of(&shape);
  shapes_free(&shape);
  for (int k = 0; k < 3; k++) {
    const float half = (float)(0.5 * sides[k]);
    const float low[3] = {1 - half, 2 - half, -2};
    const float high[3] = {1 + half, 2 + half, 4};
    nsvcd_mesh part;
    if (nsvcd_mesh_cut(&level, low, high, NULL, &part)) level_fail("a chunk was refused");
    print_encoding("chunk", &part, 0, runs);
    // as many patches as a level has
    print_encoding("chunk", &part, part.triangle_count / NSVCD_LEVEL_TRIANGLES, runs);
    nsvcd_mesh_free(&part, NULL);
  }
  nsvcd_mesh_free(&level, NULL);
  shapes_gear(&shape, 0.14, 0.03, 0.06, 20);
  print_shape("gear", &shape, 20 * runs);
  shapes_torus(&shape, 0.12, 0.04, 32, 16);
  print_shape("torus", &shape, 20 * runs);
  shapes_chair(&shape, 0.24, 0.5, 0.03);
  print_shape("chair", &shape, 20 * runs);
  return 0;
}

int main(int argc, char **argv) {
  if (argc > 1 && strcmp(argv[1], "encode") == 0)
    return print_encodings(argc > 2 ? strtoul(argv[2], NULL, 10) : 21);
  const size_t triangles = argc > 1 ? strtoul(argv[1], NULL, 10) : 200000;
  const size_t motions = argc > 2 ? strtoul(argv[2], NULL, 10) : 200;
  const int network = argc > 4 && strcmp(argv[4], "network") == 0;
  level_solid level, bodies[LEVEL_BODIES];
  shapes_mesh shape;
  nsvcd_encode_options options;
  memset(&level, 0, sizeof level);
  memset(bodies, 0, sizeof bodies);
  memset(&shape, 0, sizeof shape);
  memset(&options, 0, sizeof options);
  options.latents = network;
  if (argc > 3) options.patches = strtoul(argv[3], NULL, 10);
  if (options.patches == 0) options.patch_radius = triangles > NSVCD_MANY_TRIANGLES ? 0 : RADIUS;
  setvbuf(stdout, NULL, _IOLBF, 0);
  level_make_bodies(bodies);
  level_make(&shape, SIDE, triangles, 1);
  level_solid_init(&level, &shape, 0);

  heap h = {0, 0};
  nsvcd_allocator allocator = {heap_alloc, heap_free, &h};
  const double start = seconds();
  if (nsvcd_encode(&level.mesh, &options, &allocator, NULL, 0, &level.body))
    level_fail("the level was refused");
  const double took = seconds() - start;
  const nsvcd_body_facts facts = nsvcd_body_describe(level.body);
  const double per = 1 / (double)level.mesh.triangle_count;
  printf(
      "%zu triangles, N = %zu: encoded in %.0f ms, at most %.0f bytes a triangle at a time; body "
      "%.1f MB, %.1f bytes a "
      "triangle; quantum %.1f um\n",
      level.mesh.triangle_count, facts.patches, 1e3 * took, per * (double)h.most,
      1e-6 * (double)facts.size, per * (double)facts.size, 1e6 * (double)facts.quantization_error);

  const size_t size = nsvcd_sweep_workspace_size(NULL);
  void *workspace = malloc(size);
  size_t wrong = 0;
  for (int set = 0; set < LEVEL_SETS; set++) {
    wrong += run_set(set, motions, bodies, &level,
                     network ? NSVCD_METHOD_NETWORK : NSVCD_METHOD_PROOF, workspace, size);
  }
  return !network && wrong > 0;
}
