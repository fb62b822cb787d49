// Levels: bodies of more patches than a tile. The spheres above the groups and the walk through
// them, meshes encoded region by region, and what is answered, against the oracle and against local
// pieces. Across sections (regions, body, facets, encoding, proof, winding number, query,
// optimizer), and a file of its own: all of it needs one level of 60,000 triangles, made once.
#define _POSIX_C_SOURCE 200809L
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/body/scale.h"
#include "../src/body/encode.h"
#include "../src/body/shapes.h"
#include "../src/plan/plan.h"

#include <sys/mman.h>

#include "check.h"
#include "bench/meter.h"
#include "level_scene.h"
#include "question_of.h"
#include "../examples/scenery/status_of.h"

void test_level(void);

// ---- scenes

static nsvcd_encode_options level_options(size_t points) {
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.patches = points;
  return options;
}

static void *level_workspace(void) {
  static void *memory;
  if (!memory) memory = malloc(nsvcd_sweep_workspace_size(NULL));
  return memory;
}

static nsvcd_answer level_ask(const nsvcd_question *question) {
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_sweep(question, level_workspace(), nsvcd_sweep_workspace_size(NULL), &answer),
           NSVCD_OK);
  return answer;
}

// A level of about so many triangles, and bodies that move in it.
typedef struct level_world {
  level_solid level, bodies[LEVEL_BODIES];
} level_world;

static const level_world *level_shared(void) {
  static level_world world;
  if (world.level.body) return &world;
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  level_make(&shape, 20, 60000, 1);
  level_solid_init(&world.level, &shape, 0);
  const nsvcd_encode_options options = level_options(5000);
  CHECK_EQ(nsvcd_encode(&world.level.mesh, &options, NULL, NULL, 0, &world.level.body), NSVCD_OK);
  level_make_bodies(world.bodies);
  return &world;
}

// ---- the body

static float level_square(const float *d) {
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// Spheres that touch a ball, as a filter of a walk.
static uint32_t level_touch(const void *what, nsvcd__spheres all) {
  const float *ball = (const float *)what;
  uint32_t met = 0;
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const float d[3] = {all.x[l] - ball[0], all.y[l] - ball[1], all.z[l] - ball[2]};
    const float reach = all.r[l] + ball[3];
    met |= (uint32_t)(reach >= 0 && level_square(d) <= reach * reach) << l;
  }
  return met;
}

// ---- what is answered

static nsvcd_question level_question(const level_way *way, const nsvcd_body *fixed) {
  return question_of(way->body->body, way->stored, 2, fixed, NULL, NULL);
}

// A body mapped from a file, where nobody can write, and trusted, is as good as one in memory.
static void level_mapped_from_a_file(void) {
  const level_world *w = level_shared();
  const size_t size = nsvcd_body_describe(w->level.body).size;
  FILE *file = tmpfile();
  CHECK(file && fwrite(w->level.body, 1, size, file) == size && fflush(file) == 0);
  char *mapped = (char *)mmap(NULL, size, PROT_READ, MAP_PRIVATE, fileno(file), 0);
  CHECK(mapped != MAP_FAILED);
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_body_trust(mapped, size, &body), NSVCD_OK);
  shapes_rng rng = {6};
  for (int trial = 0; trial < 20; trial++) {
    const level_way way = level_draw(&rng, trial % LEVEL_SETS, w->bodies, &w->level);
    const nsvcd_question question = level_question(&way, w->level.body);
    const nsvcd_question from_file = level_question(&way, body);
    const nsvcd_answer a = level_ask(&question);
    const nsvcd_answer b = level_ask(&from_file);
    CHECK_EQ(status_of(&a), status_of(&b));
    CHECK_EQ(a.work, b.work);
    CHECK(memcmp(&a.nearest, &b.nearest, sizeof a.nearest) == 0);
  }
  munmap(mapped, size);
  fclose(file);
}

// The level, the piece of it that the motion can reach, and the oracle say the same; at rest,
// whichever is asked about first.
static void level_verdicts_are_right(void) {
  const level_world *w = level_shared();
  size_t hits = 0;
  size_t asked = 0;
  size_t undecided = 0;
  for (int set = 0; set < LEVEL_SETS; set++) {
    shapes_rng rng = {(uint64_t)(7 + set)};
    for (int trial = 0; trial < 25; trial++) {
      const level_way way = level_draw(&rng, set, w->bodies, &w->level);
      const oracle_result label = level_label(&way, &w->level);
      const nsvcd_question question = level_question(&way, w->level.body);
      const nsvcd_answer answer = level_ask(&question);
      const int collides = label.status == ORACLE_COLLIDES || label.status == ORACLE_INSIDE;
      undecided += status_of(&answer) == STATUS_UNDECIDED;
      hits += collides != 0;
      asked++;
      if (label.status == ORACLE_FREE && label.distance < 1e-4) continue;
      CHECK_EQ(collides_of(&answer), collides);

      const nsvcd_body *piece = level_piece(&w->level, way.body, way.stored);
      if (piece) {
        const nsvcd_question local = level_question(&way, piece);
        const nsvcd_answer other = level_ask(&local);
        if (label.status != ORACLE_INSIDE) CHECK_EQ(collides_of(&other), collides);
        nsvcd_body_free(piece, NULL);
      }

      nsvcd_question rest = question;
      rest.a.count = 1;
      const nsvcd_answer here = level_ask(&rest);
      nsvcd_question turned = rest;
      turned.a = rest.b;
      turned.b = rest.a;
      const nsvcd_answer there = level_ask(&turned);
      CHECK_EQ(status_of(&here), status_of(&there));
    }
  }
  printf("  %zu motions, %zu hits, %zu undecided\n", asked, hits, undecided);
  CHECK_EQ(undecided, 0);
  CHECK(hits > 20 && asked - hits > 20);
}

// A level that is carried past a body at rest: then the level is the moving one, searched tile by
// tile.
static void level_that_moves(void) {
  const level_world *w = level_shared();
  shapes_rng rng = {3};
  size_t hits = 0;
  for (int trial = 0; trial < 40; trial++) {
    const level_way way = level_draw(&rng, LEVEL_NEAR, w->bodies, &w->level);
    nsvcd_question question = level_question(&way, w->level.body);
    // The body keeps its first rotation and goes straight; or the level goes the other way.
    nsvcd_pose straight[2] = {way.stored[0], way.stored[0]};
    nsvcd_pose back[2];
    memset(back, 0, sizeof back);
    for (int k = 0; k < 3; k++) {
      straight[1].position[k] = straight[0].position[k] + 0.0625f;  // exact
      back[1].position[k] = -0.0625f;
    }
    back[0].rotation[3] = back[1].rotation[3] = 1;
    question.a.poses = straight;
    const nsvcd_answer one = level_ask(&question);
    question.a.count = 1;
    question.b.poses = back;
    question.b.count = 2;
    const nsvcd_answer other = level_ask(&question);
    CHECK_EQ(collides_of(&one), collides_of(&other));
    CHECK(status_of(&other) != STATUS_UNDECIDED);
    hits += (size_t)collides_of(&other);
  }
  CHECK(hits > 5 && hits < 35);
}

// First contacts and clearances are those of the local piece.
static void level_contacts_are_those_of_the_piece(void) {
  const level_world *w = level_shared();
  shapes_rng rng = {4};
  size_t contacts = 0;
  for (int trial = 0; trial < 40; trial++) {
    const level_way way = level_draw(&rng, LEVEL_DASH, w->bodies, &w->level);
    const nsvcd_body *piece = level_piece(&w->level, way.body, way.stored);
    if (!piece) continue;
    nsvcd_question question = level_question(&way, w->level.body);
    nsvcd_question local = level_question(&way, piece);
    question.ask = local.ask = NSVCD_ASK_FIRST;
    question.to_time = local.to_time = 0.001f;
    const nsvcd_answer whole = level_ask(&question);
    const nsvcd_answer part = level_ask(&local);
    if (status_of(&whole) == STATUS_WITNESS && status_of(&part) == STATUS_WITNESS) {
      CHECK_NEAR(contact_time_of(&whole), contact_time_of(&part), 0.0021);
      CHECK_LE(whole.time.low, contact_time_of(&whole));
      CHECK_LE(contact_time_of(&whole) - 0.00101f, whole.time.low);
      contacts++;
    }
    if (status_of(&whole) != STATUS_INSIDE) CHECK_EQ(collides_of(&whole), collides_of(&part));
    nsvcd_body_free(piece, NULL);

    question.ask = NSVCD_ASK_DISTANCE;
    question.to_time = 0;
    question.to = 0.001f;
    const nsvcd_answer measured = level_ask(&question);
    const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
    const oracle_options exact = {1e-4, 0, 0, 1};
    if (status_of(&measured) != STATUS_CERTIFIED_FREE) continue;
    const oracle_result label =
        oracle_sweep(&way.body->oracle, way.poses, 2, &w->level.oracle, &origin, &exact);
    CHECK_LE(measured.distance.low, label.distance);
    CHECK_LE(label.lower, measured.distance.high);
    CHECK_LE(measured.distance.high - measured.distance.low, 0.0013);
  }
  CHECK(contacts > 10);
}

// What is said of a body that rests upright at (x, y, 0).
static status level_status_at(const nsvcd_body *body, float x, float y, const nsvcd_body *fixed) {
  const nsvcd_pose at = {{x, y, 0}, {0, 0, 0, 1}};
  const nsvcd_question question = question_of(body, &at, 1, fixed, NULL, NULL);
  const nsvcd_answer answer = level_ask(&question);
  return status_of(&answer);
}

// ---- by the network

// The level of level_shared() with latents too.
static const nsvcd_body *level_with_latents(void) {
  static const nsvcd_body *body;
  nsvcd_encode_options options = level_options(5000);
  options.latents = 1;
  if (!body)
    CHECK_EQ(nsvcd_encode(&level_shared()->level.mesh, &options, NULL, NULL, 0, &body), NSVCD_OK);
  return body;
}

static void *level_zeroed(size_t size, void *user) {
  (void)user;
  return calloc(1, size);
}
static void level_release(void *memory, void *user) {
  (void)user;
  free(memory);
}

// The network is right where it can be, whichever body is a; and where it certifies, there is no
// hit.
static void level_by_the_network(void) {
  const level_world *w = level_shared();
  size_t wrong = 0;
  size_t asked = 0;
  size_t certified = 0;
  size_t hits = 0;
  shapes_rng rng = {10};
  for (int trial = 0; trial < 120; trial++) {
    const level_way way =
        level_draw(&rng, trial % 2 ? LEVEL_NEAR : LEVEL_DASH, w->bodies, &w->level);
    const oracle_result label = level_label(&way, &w->level);
    const int collides = label.status == ORACLE_COLLIDES || label.status == ORACLE_INSIDE;
    nsvcd_question question = level_question(&way, level_with_latents());
    question.method = NSVCD_METHOD_NETWORK;
    const nsvcd_answer answer = level_ask(&question);
    if (status_of(&answer) == STATUS_CERTIFIED_FREE) CHECK(!collides);
    certified += status_of(&answer) == STATUS_CERTIFIED_FREE;
    wrong += collides_of(&answer) != collides;
    hits += collides != 0;
    asked++;
    nsvcd_question turned = question;
    turned.a = question.b;
    turned.b = question.a;
    CHECK_EQ(level_ask(&turned).verdict != NSVCD_FREE, collides_of(&answer));
  }
  printf("  by the network: %zu of %zu wrong, %zu hits, %zu certified\n", wrong, asked, hits,
         certified);
  CHECK(hits > 30 && asked - hits > 30);
  CHECK_LE(wrong, asked / 10);

  const level_way way = level_draw(&(shapes_rng){11}, LEVEL_NEAR, w->bodies, &w->level);
  nsvcd_question question = level_question(&way, w->level.body);
  nsvcd_answer answer;
  question.method = NSVCD_METHOD_NETWORK;  // which this one has nothing for
  CHECK_EQ(nsvcd_sweep(&question, level_workspace(), nsvcd_sweep_workspace_size(NULL), &answer),
           NSVCD_ERROR_LATENTS);
}

// A ball in one of many crates is inside, and between two of them it is not.
static void level_containment_by_the_network(void) {
  shapes_mesh shape, pebble;
  memset(&shape, 0, sizeof shape);
  memset(&pebble, 0, sizeof pebble);
  for (int i = 0; i < 400; i++) {
    const size_t first = shape.vertices;
    shapes_box(&shape, 0.15, 0.15, 0.15, 3);
    shapes_place(&shape, first, NULL, 0.4 * (i % 20), 0.4 * (i / 20), 0.002 * (i % 7));
  }
  level_boulder(&pebble, 0.01, 8, 1);
  level_solid crates, ball;
  level_solid_init(&crates, &shape, 0);
  level_solid_init(&ball, &pebble, 0);
  nsvcd_encode_options options = level_options(20000);
  options.no_triangles = 1;
  CHECK_EQ(nsvcd_encode(&crates.mesh, &options, NULL, NULL, 0, &crates.body), NSVCD_OK);
  options.patches = 32;
  CHECK_EQ(nsvcd_encode(&ball.mesh, &options, NULL, NULL, 0, &ball.body), NSVCD_OK);
  for (int i = 0; i < 400; i += 13) {
    const float x = 0.4f * (float)(i % 20);
    const float y = 0.4f * (float)(i / 20);
    CHECK_EQ(level_status_at(ball.body, x, y, crates.body), STATUS_INSIDE);
    CHECK_EQ(level_status_at(ball.body, x + 0.2f, y, crates.body), STATUS_CERTIFIED_FREE);
  }
  level_free(&crates);
  level_free(&ball);
}

#ifndef NSVCD_NO_OPTIMIZER
static void level_place(void *user, const float *joints, nsvcd_pose *poses) {
  (void)user;
  memset(poses, 0, 2 * sizeof *poses);
  memcpy(poses[0].position, joints, sizeof poses[0].position);
  poses[0].rotation[3] = poses[1].rotation[3] = 1;
}

// A body flies through the level where the straight way is barred, and the oracle sees it touch
// nothing.
static void level_planning(void) {
  const level_world *w = level_shared();
  const level_solid *flyer = &w->bodies[2];
  const nsvcd_body *bodies[2] = {flyer->body, level_with_latents()};
  const nsvcd_body_pair pair = {0, 1};
  const float low[3] = {-9, -9, 0.2f};
  const float high[3] = {9, 9, 1};
  float start[3] = {0, 0, 1};
  float goal[3] = {0, 0, 1};
  nsvcd_plan_problem problem;
  nsvcd_plan_options options;
  memset(&problem, 0, sizeof problem);
  memset(&options, 0, sizeof options);
  problem.joints = 3;
  problem.low = low;
  problem.high = high;
  problem.bodies = bodies;
  problem.body_count = 2;
  problem.pairs = &pair;
  problem.pair_count = 1;
  problem.kinematics = level_place;
  problem.start = start;
  problem.goal = goal;
  const size_t size = nsvcd_plan_workspace_size(&problem, &options);
  CHECK(size > 0);
  void *workspace = malloc(size);
  shapes_rng rng = {12};
  size_t barred = 0;
  size_t solved = 0;
  while (barred < 4) {
    float control[3 * (NSVCD_MAX_VIA_POINTS + 2)];
    nsvcd_plan_answer answer;
    level_way way;
    memset(&answer, 0, sizeof answer);
    way.body = flyer;
    for (int k = 0; k < 3; k++) {
      start[k] = (float)shapes_uniform(&rng, (double)low[k], (double)high[k]);
      goal[k] = k == 2 ? start[2] : start[k] + (float)shapes_uniform(&rng, -1.5, 1.5);
      goal[k] = fminf(fmaxf(goal[k], low[k]), high[k]);
    }
    level_place(NULL, start, way.stored);
    way.stored[1] = way.stored[0];
    memcpy(way.stored[1].position, goal, sizeof goal);
    const nsvcd_question straight = level_question(&way, w->level.body);
    nsvcd_question end = straight;
    end.a.count = 1;
    if (level_ask(&end).verdict != NSVCD_FREE || level_ask(&straight).verdict == NSVCD_FREE)
      continue;
    end.a.poses = way.stored + 1;
    if (level_ask(&end).verdict != NSVCD_FREE) continue;
    barred++;
    CHECK_EQ(nsvcd_plan(&problem, &options, workspace, size, control, &answer), NSVCD_OK);
    if (answer.status != NSVCD_PLAN_CONVERGED) continue;
    solved++;
    oracle_pose poses[65];
    for (size_t n = 0; n <= 64; n++) {
      nsvcd_pose at[2];
      float joints[3];
      nsvcd_spline(control, answer.via_points, 3, (float)n / 64, 0, joints);
      level_place(NULL, joints, at);
      poses[n] = pose_widened(&at[0]);
    }
    const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
    const oracle_options exact = {2e-5, 1e-3, 0, 0};
    CHECK_EQ(oracle_sweep(&flyer->oracle, poses, 65, &w->level.oracle, &origin, &exact).status,
             ORACLE_FREE);
  }
  printf("  %zu of %zu barred ways solved\n", solved, barred);
  CHECK_LE(3, solved);
  free(workspace);
}
#endif

// ---- bad input

// Half of the triangles have no area, or the level is inside out, or one triangle of 20 m lies
// among crumbs of a millimetre: encoded, and the answer is that of the sane half.
static void level_of_bad_triangles(void) {
  const level_world *w = level_shared();
  const nsvcd_mesh *sane = &w->level.mesh;
  nsvcd_mesh mesh = *sane;
  mesh.triangle_count = 2 * sane->triangle_count;
  mesh.indices = (uint32_t *)malloc(12 * mesh.triangle_count);
  for (size_t t = 0; t < sane->triangle_count; t++) {
    memcpy(mesh.indices + 6 * t, sane->indices + 3 * t, 12);
    // two corners are one
    for (size_t k = 0; k < 3; k++) mesh.indices[6 * t + 3 + k] = sane->indices[3 * t + (k > 1)];
  }
  const nsvcd_encode_options options = level_options(4000);
  const nsvcd_body *half, *turned, *crumbs;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &half), NSVCD_OK);
  for (size_t t = 0; t < sane->triangle_count; t++) {
    const uint32_t *c = sane->indices + 3 * t;
    uint32_t *to = mesh.indices + 3 * t;
    to[0] = c[0];
    to[1] = c[2];
    to[2] = c[1];
  }
  mesh.triangle_count = sane->triangle_count;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &turned), NSVCD_OK);
  shapes_rng rng = {5};
  for (int trial = 0; trial < 30; trial++) {
    const level_way way = level_draw(&rng, LEVEL_NEAR, w->bodies, &w->level);
    nsvcd_question question = level_question(&way, w->level.body);
    const int collides = level_ask(&question).verdict != NSVCD_FREE;
    question.b.body = half;
    CHECK_EQ(level_ask(&question).verdict != NSVCD_FREE, collides);
    question.b.body = turned;  // it winds once the other way about what is inside
    CHECK_EQ(level_ask(&question).verdict != NSVCD_FREE, collides);
  }
  nsvcd_body_free(half, NULL);
  nsvcd_body_free(turned, NULL);
  free(mesh.indices);

  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  const uint32_t a = shapes_vertex(&shape, -10, -10, 0);
  const uint32_t b = shapes_vertex(&shape, 10, -10, 0);
  shapes_triangle(&shape, a, b, shapes_vertex(&shape, 0, 10, 0));
  for (int i = 0; i < 3000; i++) {
    const size_t first = shape.vertices;
    shapes_box(&shape, 0.001, 0.001, 0.001, 1);
    shapes_place(&shape, first, NULL, 0.002 * (i % 60), 0.002 * (i / 60), 0.3);
  }
  level_solid solid;
  level_solid_init(&solid, &shape, 0);
  CHECK_EQ(nsvcd_encode(&solid.mesh, &options, NULL, NULL, 0, &crumbs), NSVCD_OK);
  solid.body = crumbs;
  for (int trial = 0; trial < 30; trial++) {
    nsvcd_pose at = {{0, 0, trial % 2 ? 0.0502f : 0.0498f}, {0, 0, 0, 1}};
    for (int k = 0; k < 2; k++) at.position[k] = (float)shapes_uniform(&rng, -4, 4);
    // a box of 0.3 x 0.2 x 0.1 m
    const nsvcd_question question = question_of(w->bodies[1].body, &at, 1, crumbs, NULL, NULL);
    CHECK_EQ(level_ask(&question).verdict != NSVCD_FREE, trial % 2 == 0);
  }
  level_free(&solid);
}

// Encoding takes at most 100 bytes a triangle at a time, from 10,000 triangles on, in one region
// and in several.
static void level_encoding_is_frugal(void) {
  const size_t sizes[3] = {10000, 40000, 60000};
  for (int i = 0; i < 3; i++) {
    shapes_mesh shape;
    level_solid solid;
    heap h = {0, 0};
    const nsvcd_allocator allocator = {heap_alloc, heap_free, &h};
    const nsvcd_encode_options options = level_options(i < 2 ? 0 : 5000);
    memset(&shape, 0, sizeof shape);
    level_make(&shape, 20, sizes[i], 1);
    level_solid_init(&solid, &shape, 0);
    CHECK_EQ(nsvcd_encode(&solid.mesh, &options, &allocator, NULL, 0, &solid.body), NSVCD_OK);
    const double most = (double)h.most / (double)solid.mesh.triangle_count;
    printf("  %zu triangles: %.0f bytes for each\n", solid.mesh.triangle_count, most);
    CHECK_LE(most, 100);
    nsvcd_body_free(solid.body, &allocator);
    solid.body = NULL;
    level_free(&solid);
  }
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// Every sphere holds those below it, and a walk finds the groups that pass, in order: no more, and
// none less.
static void level_walks_find_all(void) {
  const nsvcd_body *body = level_shared()->level.body;
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  shapes_rng rng = {1};
  CHECK_EQ(facts.latents, 0);
  CHECK(facts.patches > 4096);
  CHECK_EQ(nsvcd__level_count(body->padded), 3);
  for (size_t k = 1; k < nsvcd__level_count(body->padded); k++) {
    const nsvcd__level below = nsvcd__level_of(body->padded, k - 1);
    const nsvcd__level above = nsvcd__level_of(body->padded, k);
    const float *inner = nsvcd__body_floats(body, below.first);
    const float *outer = nsvcd__body_floats(body, above.first);
    CHECK_EQ(above.count, (below.count + 15) / 16);
    for (size_t i = 0; i < below.count; i++) {
      double square = 0;
      for (size_t n = 0; n < 3; n++) {
        const double d =
            (double)inner[n * below.slots + i] - (double)outer[n * above.slots + i / 16];
        square += d * d;
      }
      const double radius =
          (double)outer[3 * above.slots + i / 16] - (double)inner[3 * below.slots + i];
      CHECK_LE(sqrt(square), radius * (1 + 1e-6));
    }
  }

  size_t found = 0;
  for (int trial = 0; trial < 300; trial++) {
    const float ball[4] = {(float)shapes_uniform(&rng, -11, 11),
                           (float)shapes_uniform(&rng, -11, 11), (float)shapes_uniform(&rng, -2, 3),
                           (float)pow(10, shapes_uniform(&rng, -2, 1.3))};
    nsvcd__traversal walk;
    nsvcd__traversal_begin(&walk, body, level_touch, ball);
    for (size_t g = 0; g < nsvcd__body_groups(body); g++) {
      const float d[3] = {nsvcd__groups_of(body).x[g] - ball[0],
                          nsvcd__groups_of(body).y[g] - ball[1],
                          nsvcd__groups_of(body).z[g] - ball[2]};
      const float reach = nsvcd__groups_of(body).r[g] + ball[3];
      size_t next = 0;
      if (level_square(d) > reach * reach) continue;
      CHECK(nsvcd__traversal_next(&walk, &next));
      CHECK_EQ(next, g);
      found++;
    }
    size_t more;
    CHECK(!nsvcd__traversal_next(&walk, &more));
  }
  CHECK_LE(1000, found);
}

// A copy loads, and moves; a sphere of an upper level that does not hold those below it is refused.
static void level_blobs_are_checked(void) {
  const nsvcd_body *body = level_shared()->level.body;
  const size_t size = nsvcd_body_describe(body).size;
  nsvcd_body *copy = (nsvcd_body *)malloc(size);
  const nsvcd_body *loaded = NULL;
  memcpy(copy, body, size);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_OK);
  CHECK(loaded == copy);
  CHECK_EQ(nsvcd_body_load(copy, size - 8, &loaded), NSVCD_ERROR_BODY);
  for (size_t k = 0; k < nsvcd__level_count(body->padded); k++) {
    const nsvcd__level level = nsvcd__level_of(body->padded, k);
    float *radius = (float *)(copy + 1) + level.first + 3 * level.slots + level.count / 2;
    const float before = *radius;
    *radius *= 0.9f;
    copy->checksum = nsvcd__body_checksum(copy);
    CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_ERROR_BODY);
    *radius = before;
  }
  copy->checksum = nsvcd__body_checksum(copy);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_OK);
  CHECK_EQ(nsvcd_body_scale(body, (const float[3]){0.5f, 0.5f, 0.5f}, copy, size, &loaded),
           NSVCD_OK);
  const nsvcd_body_facts half = nsvcd_body_describe(loaded);
  CHECK_NEAR(half.radius / nsvcd_body_describe(body).radius, 0.5, 1e-5);
  CHECK_EQ(nsvcd_body_load(copy, size, &loaded), NSVCD_OK);
  free(copy);
}

// Pebbles that float: one within a box is found, though there are many, and one outside of it is
// not.
static void level_components_are_found(void) {
  enum { PEBBLES = 900 };
  shapes_mesh shape, crate;
  memset(&shape, 0, sizeof shape);
  memset(&crate, 0, sizeof crate);
  for (int i = 0; i < PEBBLES; i++) {
    const size_t first = shape.vertices;
    shapes_box(&shape, 0.02, 0.02, 0.02, 1);
    shapes_place(&shape, first, NULL, 0.2 * (i % 30), 0.2 * (i / 30), 0.001 * (i % 7));
  }
  shapes_box(&crate, 0.1, 0.1, 0.1, 2);
  level_solid pebbles, box;
  level_solid_init(&pebbles, &shape, 0);
  level_solid_init(&box, &crate, 0);
  const nsvcd_encode_options options = level_options(2000);
  CHECK_EQ(nsvcd_encode(&pebbles.mesh, &options, NULL, NULL, 0, &pebbles.body), NSVCD_OK);
  CHECK_EQ(nsvcd_encode(&box.mesh, NULL, NULL, NULL, 0, &box.body), NSVCD_OK);
  const nsvcd__geometry f = nsvcd__geometry_of(nsvcd__triangles_of(pebbles.body));
  CHECK_EQ(f.counts->components, PEBBLES);
  for (int i = 0; i < PEBBLES; i += 41) {
    const float x = 0.2f * (float)(i % 30);
    const float y = 0.2f * (float)(i / 30);
    CHECK_EQ(level_status_at(box.body, x, y, pebbles.body), STATUS_INSIDE);
    // Between two of them.
    CHECK_EQ(level_status_at(box.body, x + 0.1f, y, pebbles.body), STATUS_CERTIFIED_FREE);
  }
  level_free(&pebbles);
  level_free(&box);
}

// Asked for, they stand before the body for the proof, which is the same to the byte, each patch of
// each region has some; not asked for, a level has none. The blob is checked, and scales.
static void level_latents_are_added(void) {
  const nsvcd_body *plain = level_shared()->level.body;
  const nsvcd_body *body = level_with_latents();
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  const nsvcd_body *inner = nsvcd__triangles_of(body);
  const nsvcd_body *loaded = NULL;
  CHECK_EQ(facts.latents, 1);
  CHECK_EQ(facts.patches, nsvcd_body_describe(plain).patches);
  CHECK_EQ(inner->size, plain->size);
  CHECK(memcmp(inner, plain, plain->size) == 0);

  nsvcd_encode_options options = level_options(600);
  const nsvcd_body *other = NULL;
  CHECK_EQ(nsvcd_encode(&level_shared()->bodies[1].mesh, &options, NULL, NULL, 0, &other),
           NSVCD_OK);
  CHECK_EQ(nsvcd_body_describe(other).latents, 0);
  nsvcd_body_free(other, NULL);
  const nsvcd_allocator zeroed = {level_zeroed, level_release, NULL};
  options.no_triangles = 1;  // then they are all there is
  CHECK_EQ(nsvcd_encode(&level_shared()->bodies[1].mesh, &options, &zeroed, NULL, 0, &other),
           NSVCD_OK);
  CHECK_EQ(nsvcd_body_describe(other).latents, 1);
  CHECK_EQ(other->size, nsvcd_body_size(other->patches));
  CHECK_GE(other->patches, 513);  // of several regions
  for (size_t i = 0; i < other->patches; i++) {
    const int8_t *latent = nsvcd__body_latents(other) + NSVCD__LATENT * i;
    int most = 0;
    for (size_t k = 0; k < NSVCD__LATENT; k++) most = abs(latent[k]) > most ? abs(latent[k]) : most;
    CHECK_GE(most, 1);
  }
  nsvcd_body_free(other, &zeroed);

  nsvcd_body *copy = (nsvcd_body *)malloc(facts.size);
  memcpy(copy, body, facts.size);
  CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_OK);
  for (size_t n = 0; n < nsvcd__level_count(body->padded); n++) {
    float *sum =
        (float *)nsvcd__writable(copy, nsvcd__level_areas(copy, nsvcd__level_of(copy->padded, n)));
    const float before = *sum;
    *sum = HUGE_VALF;
    copy->checksum = nsvcd__body_checksum(copy);
    CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_ERROR_BODY);
    *sum = before;
  }
  CHECK_EQ(nsvcd_body_scale(body, (const float[3]){0.5f, 0.5f, 0.5f}, copy, facts.size, &loaded),
           NSVCD_OK);
  const nsvcd__level top = nsvcd__level_of(body->padded, nsvcd__level_count(body->padded) - 1);
  for (size_t i = 0; i < 3 * top.slots; i++) {
    CHECK_NEAR(nsvcd__level_areas(loaded, top)[i], 0.25 * (double)nsvcd__level_areas(body, top)[i],
               1e-4);
  }
  CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_OK);
  free(copy);
}

// The balls of patches contain the surface, those of halved triangles too.
static void level_balls_cover(void) {
  const nsvcd_body *body = level_with_latents();
  const oracle_mesh *mesh = &level_shared()->level.oracle;
  shapes_rng rng = {8};
  for (int trial = 0; trial < 2000; trial++) {
    const oracle_triangle *t = &mesh->triangles[shapes_next(&rng) % mesh->triangle_count];
    double u = shapes_uniform(&rng, 0, 1);
    double v = trial % 2 ? 0 : shapes_uniform(&rng, 0, 1);
    double place[3];
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    for (int k = 0; k < 3; k++)
      place[k] = t->v[0][k] + u * (t->v[1][k] - t->v[0][k]) + v * (t->v[2][k] - t->v[0][k]);
    int covered = 0;
    for (size_t i = 0; i < body->patches && !covered; i++) {
      const double d[3] = {(double)nsvcd__body_patches(body).x[i] - place[0],
                           (double)nsvcd__body_patches(body).y[i] - place[1],
                           (double)nsvcd__body_patches(body).z[i] - place[2]};
      covered = oracle_length(d) <= (double)nsvcd__body_r(body)[i];
    }
    CHECK(covered);
  }
}

// Clearances and winding numbers, found through the levels, are those over all patches; so are the
// sums of area vectors.
static void level_winding_numbers_are_those_of_the_patches(void) {
  const nsvcd_body *body = level_with_latents();
  const float *areas = nsvcd__body_areas(body);
  double worst = 0;
  double sums[3] = {0, 0, 0};
  size_t inside = 0;
  size_t clear = 0;
  shapes_rng rng = {9};
  for (int trial = 0; trial < 1000; trial++) {
    nsvcd__probes all;
    const double spread = pow(10, shapes_uniform(&rng, -2, 0.5));
    double middle[3];
    for (int k = 0; k < 3; k++)
      middle[k] = k == 2 ? shapes_uniform(&rng, -1.2, 2) : shapes_uniform(&rng, -10.5, 10.5);
    for (size_t n = 0; n < NSVCD__PROBES; n++) {
      for (int k = 0; k < 3; k++)
        all.at[k][n] = (float)(middle[k] + spread * shapes_uniform(&rng, -0.5, 0.5));
    }
    nsvcd__probes_measure(body, &all);
    for (size_t n = 0; n < NSVCD__PROBES; n++) {
      const float place[3] = {all.at[0][n], all.at[1][n], all.at[2][n]};
      double least = (double)(NSVCD__AMPLE * NSVCD__AMPLE);
      double w = 0;
      for (size_t i = 0; i < body->patches; i++) {
        const double d[3] = {(double)(nsvcd__body_patches(body).x[i] - place[0]),
                             (double)(nsvcd__body_patches(body).y[i] - place[1]),
                             (double)(nsvcd__body_patches(body).z[i] - place[2])};
        const double length = oracle_length(d);
        const double r = (double)nsvcd__body_r(body)[i];
        least = fmin(least, length * length / (r * r));
        for (size_t k = 0; k < 3; k++)
          w += (double)areas[k * body->padded + i] * d[k] / (length * length * length);
      }
      w /= 4 * acos(-1);
      CHECK_NEAR(all.square[n], least, 1e-4);
      if (n > 0 || least < 1) continue;
      const double found = (double)nsvcd__winding_number(body, nsvcd__f3_load(place));
      worst = fmax(worst, fabs(found - w));
      inside += fabs(w) > 0.5;
      clear++;
    }
  }
  printf("  winding numbers of %zu places, %zu inside: within %.4f of those of all patches\n",
         clear, inside, worst);
  CHECK(inside > 50 && clear - inside > 50);
  CHECK_LE(worst, 0.05);

  const nsvcd__level top = nsvcd__level_of(body->padded, nsvcd__level_count(body->padded) - 1);
  for (size_t k = 0; k < 3; k++) {
    for (size_t i = 0; i < body->patches; i++) sums[k] += (double)areas[k * body->padded + i];
    for (size_t i = 0; i < top.slots; i++)
      sums[k] -= (double)nsvcd__level_areas(body, top)[k * top.slots + i];
    CHECK_NEAR(sums[k], 0, 1e-3);
  }
}

// ---- casts: small bodies, which are searched in the order in which they come to things

enum { CAST_RAY, CAST_SPHERE, CAST_CAPSULE, CAST_BOX, CAST_MUG, CASTS };

// A body, and the oracle's mesh of its skeleton.
typedef struct level_caster {
  const nsvcd_body *body;
  oracle_mesh skeleton;
  double round;
} level_caster;

static level_caster level_caster_make(int kind) {
  static const float ends[2][3] = {{0, 0.1f, -0.3f}, {0, 0, 0.3f}};
  static const float half[3] = {0.1f, 0.15f, 0.05f};
  static const uint32_t line[3] = {0, 1, 1};
  static const double round[CASTS] = {5e-4, 0.05, 0.1, 0, 0};
  const size_t count = kind == CAST_CAPSULE ? 2 : 1;
  double points[6] = {0};
  level_caster out;
  memset(&out, 0, sizeof out);
  out.round = round[kind];
  const float radius = (float)out.round;
  for (size_t i = 0; i < 3 * count && kind == CAST_CAPSULE; i++)
    points[i] = (double)ends[i / 3][i % 3];
  if (kind < CAST_CAPSULE) CHECK_EQ(nsvcd_encode_sphere(radius, NULL, &out.body), NSVCD_OK);
  if (kind == CAST_CAPSULE)
    CHECK_EQ(nsvcd_encode_capsule(ends[0], ends[1], radius, NULL, &out.body), NSVCD_OK);
  if (kind >= CAST_BOX) {
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    if (kind == CAST_BOX) shapes_box(&shape, 0.2, 0.3, 0.1, 1);
    if (kind == CAST_MUG) shapes_mug(&shape, 0.1, 0.2, 0.01, 24);
    nsvcd_mesh mesh = mesh_of(&shape);
    CHECK_EQ(oracle_mesh_init(&out.skeleton, shape.positions, shape.vertices, shape.indices,
                              shape.triangles, 1),
             1);
    if (kind == CAST_BOX) CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &out.body), NSVCD_OK);
    if (kind == CAST_MUG) CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &out.body), NSVCD_OK);
    nsvcd_mesh_free(&mesh, NULL);
    shapes_free(&shape);
  } else {
    const uint32_t dot[3] = {0, 0, 0};
    CHECK_EQ(oracle_mesh_init(&out.skeleton, points, count, count > 1 ? line : dot, 1, 1), 1);
  }
  return out;
}

// How near the caster comes to the level between two times, at some of them.
static double level_cast_gap(const level_caster *caster, const oracle_pose *way, double from,
                             double to, int samples) {
  const oracle_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  double least = HUGE_VAL;
  for (int k = 0; k <= samples; k++) {
    const double t = from + (to - from) * k / (samples ? samples : 1);
    const oracle_pose at = oracle_pose_at(way, 2, t);
    oracle_search s;
    oracle_search_begin(&s, &caster->skeleton, &level_shared()->level.oracle);
    least = fmin(least, oracle_search_run(&s, &at, &origin, HUGE_VAL));
  }
  return least - caster->round;
}

// When a corner of the skeleton's first triangle, which goes straight, first passes through a triangle
// of the level: beyond 1, never. All triangles are tried.
static double level_first_crossing(const level_caster *caster, const oracle_pose *way) {
  const oracle_mesh *level = &level_shared()->level.oracle;
  double first = HUGE_VAL;
  for (int k = 0; k < 2; k++) {
    double from[3], to[3], travel[3];
    oracle_transform(&way[0], caster->skeleton.triangles[0].v[k], from);
    oracle_transform(&way[1], caster->skeleton.triangles[0].v[k], to);
    oracle_sub(to, from, travel);
    for (size_t i = 0; i < level->triangle_count; i++) {
      const oracle_triangle *t = &level->triangles[i];
      double d[3], ahead[3], at[3];
      oracle_sub(from, t->v[0], d);
      oracle_sub(to, t->v[0], ahead);
      const double before = oracle_dot(t->normal, d);
      const double after = oracle_dot(t->normal, ahead);
      if (before * after >= 0) continue;
      const double u = before / (before - after);
      if (u >= first) continue;
      for (int j = 0; j < 3; j++) at[j] = from[j] + u * travel[j];
      if (oracle_projects_inside(t, at)) first = u;
    }
  }
  return first;
}

// A way, straight or with a turn, from near the ground, perhaps from a contact or of no length.
static void level_any_cast(shapes_rng *rng, oracle_pose *way) {
  const double length = shapes_pick(rng, 10) ? pow(10, shapes_uniform(rng, -3, 1)) : 0;
  double along[3], axis[3], turn[4];
  shapes_quaternion(rng, way[0].rotation);
  shapes_direction(rng, along);
  shapes_direction(rng, axis);
  oracle_axis_angle(axis, shapes_pick(rng, 3) ? 0 : shapes_uniform(rng, 0, 0.5), turn);
  oracle_quat_mul(turn, way[0].rotation, way[1].rotation);
  for (int k = 0; k < 2; k++) way[0].position[k] = shapes_uniform(rng, -9, 9);
  way[0].position[2] = level_height(way[0].position[0], way[0].position[1]);
  way[0].position[2] += shapes_uniform(rng, -0.1, 1);
  for (int k = 0; k < 3; k++) way[1].position[k] = way[0].position[k] + length * along[k];
}

static void level_casts_are_those_of_the_oracle(void) {
  shapes_rng rng = {431};
  size_t hits = 0;
  size_t frees = 0;
  size_t undecided = 0;
  // the level, and the same in 25 groups without levels above them, of patches of several blocks
  const nsvcd_encode_options few = level_options(400);
  const level_solid *level = &level_shared()->level;
  const nsvcd_body *bodies[2] = {level->body, NULL};
  CHECK_EQ(nsvcd_encode(&level->mesh, &few, NULL, NULL, 0, &bodies[1]), NSVCD_OK);
  for (int kind = 0; kind < CASTS; kind++) {
    level_caster caster = level_caster_make(kind);
    for (size_t trial = 0; trial < check_many(700); trial++) {
      const float to = (float)pow(10, shapes_uniform(&rng, -4, -2));
      oracle_pose way[2];
      nsvcd_pose path[2];
      level_any_cast(&rng, way);
      for (int k = 0; k < 2; k++) {
        path[k] = pose_rounded(&way[k]);
        way[k] = pose_widened(&path[k]);
      }
      nsvcd_question q = question_of(caster.body, path, 2, bodies[trial % 2], NULL, NULL);
      q.ask = shapes_pick(&rng, 3) ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
      q.to = q.ask == NSVCD_ASK_FIRST ? to : 0;
      q.clearance = shapes_pick(&rng, 3) ? 0 : (float)pow(10, shapes_uniform(&rng, -4, -1));
      q.surfaces = shapes_pick(&rng, 3) == 0;
      const nsvcd_answer a = level_ask(&q);
      const double clearance = (double)q.clearance;
      hits += a.verdict == NSVCD_HIT;
      frees += a.verdict == NSVCD_FREE;
      undecided += a.verdict == NSVCD_UNDECIDED;
      // what is proven free is beyond the clearance, to the rounding of the poses
      double travel[3];
      oracle_sub(way[1].position, way[0].position, travel);
      const double length = oracle_length(travel);
      const double low = (double)a.time.low;
      if (a.verdict == NSVCD_FREE || low > 0) {
        CHECK_GE(level_cast_gap(&caster, way, 0, low, 12), clearance - 1e-5);
        const double since = length > 0 ? fmax(0, low - 0.02 / length) : 0;
        // surfaces that meet are at distance 0
        CHECK_GE(level_cast_gap(&caster, way, since, low * (1 - 1e-6), 4),
                 caster.round > 0 ? -1e-7 : 1e-12);
      }
      const int is_straight = !memcmp(path[0].rotation, path[1].rotation, sizeof path[0].rotation);
      if (is_straight && (a.verdict == NSVCD_FREE || a.time.low > 0))
        CHECK_LE((double)a.time.low, level_first_crossing(&caster, way) + 1e-5);
      if (a.verdict != NSVCD_HIT || a.inside) continue;
      const double at = (double)a.time.high;
      CHECK_LE(level_cast_gap(&caster, way, at, at, 0), clearance + 1e-5);
      if (q.ask != NSVCD_ASK_FIRST || a.why) continue;
      // a body that turns moves more
      if (is_straight) CHECK_LE((at - low) * length, (double)to * 1.001 + 2e-5);
    }
    oracle_mesh_free(&caster.skeleton);
    nsvcd_body_free(caster.body, NULL);
  }
  nsvcd_body_free(bodies[1], NULL);
  printf("  %zu hit, %zu free, %zu undecided\n", hits, frees, undecided);
  CHECK_GE(hits, 500);
  CHECK_GE(frees, 500);
  CHECK_LE(undecided, 30);
}

void test_level(void) {
  RUN(level_mapped_from_a_file);
  RUN(level_verdicts_are_right);
  RUN(level_that_moves);
  RUN(level_casts_are_those_of_the_oracle);
  RUN(level_contacts_are_those_of_the_piece);
  RUN(level_by_the_network);
  RUN(level_containment_by_the_network);
#ifndef NSVCD_NO_OPTIMIZER
  RUN(level_planning);
#endif
  RUN(level_of_bad_triangles);
  RUN(level_encoding_is_frugal);
  // from within
  RUN(level_walks_find_all);
  RUN(level_blobs_are_checked);
  RUN(level_components_are_found);
  RUN(level_latents_are_added);
  RUN(level_balls_cover);
  RUN(level_winding_numbers_are_those_of_the_patches);
}

CHECK_ALONE(test_level)
