// What a query costs: the bound that nsvcd_sweep states, batches, threads, numbers read, and stack.
// Across sections (broad phase, proof, query), and a file of its own: here calls between rooms are
// counted, and threads ask.
#define _POSIX_C_SOURCE 200809L
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/body/encode.h"
#include "../src/segments/chords.h"

// Each thread counts for itself; so what the thread sanitizer sees is the library's.
#if defined(__GNUC__)
#define OF_THREAD __thread
#else
#define OF_THREAD
#endif
// Tests of spheres, a slice at a time; pairs, by the tiny decoder and by others; numbers read.
static OF_THREAD struct { size_t slices, ranked, judged, numbers; } counted;
// Blocks of 16 segments, some of which are wanted.
static size_t cost_blocks(uint64_t wanted) {
  size_t blocks = 0;
  for (; wanted; wanted >>= NSVCD__LANES) blocks += (wanted & 0xffff) > 0;
  return blocks;
}
// What a room calls is counted where that room is included: a macro is not expanded in itself.
#define COST_ALL (NSVCD__LANES / NSVCD__SLICE)
#define nsvcd__nearest2(d, travel, inverse) (counted.slices++, nsvcd__nearest2(d, travel, inverse))
#define nsvcd__meet(chords, resting) (counted.slices += COST_ALL, nsvcd__meet(chords, resting))
#define nsvcd__meet_members(q, s, resting) \
  (counted.slices += COST_ALL, nsvcd__meet_members(q, s, resting))
#define nsvcd__meet_in(q, wanted, resting) \
  (counted.slices += cost_blocks(wanted) * COST_ALL, nsvcd__meet_in(q, wanted, resting))
#define nsvcd__read_number(of, n) \
  (counted.numbers += (n) + 1 - (of)->next, nsvcd__read_number(of, n))
#define nsvcd__is_in_solid(f, patch, n) \
  (counted.numbers += (n) + 1 - (f)->first_triangle[patch], nsvcd__is_in_solid(f, patch, n))
#include "../src/network/decoder.h"
#define nsvcd__decoder_run(decoder, x, rows, int8, out)                            \
  (*((decoder) == nsvcd_w_decoders ? &counted.ranked : &counted.judged) += (rows), \
   nsvcd__decoder_run(decoder, x, rows, int8, out))
#include "../src/query/question.h"

#include "any_query.h"
#include "query_scene.h"

#include <pthread.h>

void test_cost(void);

// ------------------------------------------------------------------------------------------- bound

// A body whose spheres are all so large that they meet everything, wherever it is: the worst that a
// blob can be.
static void cost_blow_up(query_memory *memory, float factor) {
  struct nsvcd_body *body = (struct nsvcd_body *)memory->at;
  float *r = (float *)(body + 1) + 3 * (size_t)body->padded;
  float *group_r =
      (float *)(body + 1) + 4 * (size_t)body->padded + 3 * nsvcd__group_slots(body->padded);
  for (size_t i = 0; i < body->padded; i++) r[i] *= r[i] > 0 ? factor : 1;
  for (size_t i = 0; i < nsvcd__group_slots(body->padded); i++)
    group_r[i] *= group_r[i] > 0 ? factor : 1;
  body->radius *= factor;
  body->extent *= factor;
}

static nsvcd__query *cost_query(void) {
  static nsvcd__query *query;
  if (!query) query = any_query();
  return query;
}

// All steps of the search, as if nothing were clear before its end. Returns how many segments the
// motion has.
static size_t cost_search(const query_scene *s) {
  nsvcd__query *query = cost_query();
  nsvcd__motion motion;
  nsvcd__candidates kept;
  const nsvcd_question question =
      question_of(s->moving, s->motion, QUERY_POSES, s->fixed, &s->fixed_pose, NULL);
  nsvcd__motion_init(&question.a, &question.b, &motion);
  nsvcd__candidates_start(&kept, query->kept, 32);
  nsvcd__cut_motion(&motion, s->moving->extent + s->fixed->extent, &query->broad_phase);
  nsvcd__plane_cache_begin(&query->broad_phase, 0);
  int more = nsvcd__search_begin(s->moving, s->fixed, ~(uint64_t)0, &query->broad_phase);
  while (more) more = nsvcd__search_step(&query->broad_phase, &kept);
  return query->broad_phase.segments;
}

// ----------------------------------------------------------------------------------------- batches

#define COST_MOTIONS 48

typedef struct cost_batch {
  query_scene scene;
  nsvcd_pose poses[COST_MOTIONS * QUERY_POSES];
  nsvcd_answer single[COST_MOTIONS], batch[COST_MOTIONS];
} cost_batch;

// Motions about that of a scene, every other one far off it, so that hits and misses alternate.
static void cost_open(cost_batch *b, uint64_t seed) {
  shapes_rng rng = {seed};
  query_scene_open(&b->scene, seed);
  for (size_t m = 0; m < COST_MOTIONS; m++) {
    double offset[3];
    const double reach = m / 8 % 2 ? 0.2 : 0.02;
    for (int k = 0; k < 3; k++) offset[k] = shapes_uniform(&rng, -reach, reach);
    for (size_t i = 0; i < QUERY_POSES; i++) {
      nsvcd_pose *pose = &b->poses[m * QUERY_POSES + i];
      *pose = b->scene.motion[i];
      for (int k = 0; k < 3; k++) pose->position[k] += (float)offset[k];
    }
  }
}

static nsvcd_result cost_ask_batch(const cost_batch *b, const nsvcd_question *options,
                                   void *workspace, nsvcd_answer *answers) {
  const query_scene *s = &b->scene;
  nsvcd_question questions[COST_MOTIONS];
  for (size_t m = 0; m < COST_MOTIONS; m++) {
    questions[m] = question_of(s->moving, b->poses + m * QUERY_POSES, QUERY_POSES, s->fixed,
                               &s->fixed_pose, options);
  }
  return nsvcd_sweep_batch(questions, COST_MOTIONS, workspace, nsvcd_sweep_workspace_size(NULL),
                           answers);
}

// ----------------------------------------------------------------------------------------- threads

#define COST_THREADS 4

typedef struct cost_thread {
  pthread_t thread;
  const cost_batch *work;
  const nsvcd_question *options;
  size_t first;  // question: threads do not all ask the same at a time
  nsvcd_answer single[COST_MOTIONS], batch[COST_MOTIONS];
  nsvcd_result result;
} cost_thread;

static void *cost_run(void *argument) {
  cost_thread *t = (cost_thread *)argument;
  const query_scene *s = &t->work->scene;
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  query_memory memory = query_reserve(size);
  t->result = NSVCD_OK;
  for (int round = 0; round < 5 && !t->result; round++) {
    for (size_t n = 0; n < COST_MOTIONS && !t->result; n++) {
      const size_t m = (t->first + n) % COST_MOTIONS;
      const nsvcd_question question =
          question_of(s->moving, t->work->poses + m * QUERY_POSES, QUERY_POSES, s->fixed,
                      &s->fixed_pose, t->options);
      t->result = nsvcd_sweep(&question, memory.at, size, &t->single[m]);
    }
    if (!t->result) t->result = cost_ask_batch(t->work, t->options, memory.at, t->batch);
  }
  query_release(&memory);
  return NULL;
}

// Threads that share bodies, each with a workspace of its own, answer as one thread does, to the
// bit.
static void cost_check_threads(const cost_batch *work, const nsvcd_question *options) {
  static cost_thread threads[COST_THREADS], alone;
  alone.work = work;
  alone.options = options;
  cost_run(&alone);
  CHECK_EQ(alone.result, NSVCD_OK);
  for (size_t t = 0; t < COST_THREADS; t++) {
    threads[t].work = work;
    threads[t].options = options;
    threads[t].first = t * COST_MOTIONS / COST_THREADS;
    CHECK_EQ(pthread_create(&threads[t].thread, NULL, cost_run, &threads[t]), 0);
  }
  for (size_t t = 0; t < COST_THREADS; t++) pthread_join(threads[t].thread, NULL);
  for (size_t t = 0; t < COST_THREADS; t++) {
    CHECK_EQ(threads[t].result, NSVCD_OK);
    for (size_t m = 0; m < COST_MOTIONS; m++) {
      CHECK(query_same_proof(&threads[t].single[m], &alone.single[m]));
      CHECK(query_same_proof(&threads[t].batch[m], &alone.batch[m]));
    }
  }
}

static void cost_threads_agree(void) {
  static cost_batch b;
  for (uint64_t seed = 1; seed <= 8; seed++) {
    cost_open(&b, seed);
    cost_check_threads(&b, NULL);
    query_scene_close(&b.scene);
  }
}

// The same by proof: whether they meet, when first, how close they come, and what they rest on; of
// small bodies and of one that is searched tile by tile.
static void cost_threads_agree_by_proof(void) {
  static cost_batch b;
  for (uint64_t seed = 1; seed <= 8; seed++) {
    nsvcd_question options = query_options(0, NSVCD_MODEL_DEFAULT, 0);
    nsvcd_encode_options encoding;
    const nsvcd_body *bodies[2];
    cost_open(&b, seed);
    memset(&encoding, 0, sizeof encoding);
    encoding.patches = seed % 4 == 0 ? 700 : 0;
    for (size_t k = 0; k < 2; k++) {
      nsvcd_mesh mesh = query_solid(2 * seed + k, k ? 0.3 : 0.2);
      CHECK_EQ(nsvcd_encode(&mesh, &encoding, NULL, NULL, 0, &bodies[k]), NSVCD_OK);
      nsvcd_mesh_free(&mesh, NULL);
    }
    b.scene.moving = bodies[0];
    b.scene.fixed = bodies[1];
    if (seed % 4 == 1) {
      options.ask = NSVCD_ASK_FIRST;
      options.to_time = 0.01f;
    } else if (seed % 4 == 2) {
      options.ask = NSVCD_ASK_DISTANCE;
      options.to = 0.001f;
    }
    options.slop = seed % 4 == 3 ? 0.001f : 0;
    cost_check_threads(&b, &options);
    nsvcd_body_free(bodies[0], NULL);
    nsvcd_body_free(bodies[1], NULL);
    query_scene_close(&b.scene);
  }
}

// ----------------------------------------------------------------------------------------- numbers

// A ray through a detail of a large body, whose triangles are all so small that float rounding
// keeps them: their numbers are read once, not from the first one on for each.
static void cost_reads_numbers_once(void) {
  // the header's ray from a place on this side: 0.5359, 3 x 0.6013, 0.5927
  const double way[3] = {0.27162, 0.91432, 0.30041};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_ellipsoid(&shape, 1, 1, 1, 32);
  const size_t first = shape.vertices;
  shapes_ellipsoid(&shape, 0.005, 0.005, 0.005, 64);
  for (size_t i = 3 * first; i < 3 * shape.vertices; i++) shape.positions[i] += 0.6 * way[i % 3];
  nsvcd_mesh mesh = mesh_of(&shape);
  nsvcd_mesh speck = query_box(0.001, 0.001, 0.001);
  const nsvcd_body *large = NULL;
  const nsvcd_body *small = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &large), NSVCD_OK);
  CHECK_EQ(nsvcd_encode(&speck, NULL, NULL, NULL, 0, &small), NSVCD_OK);
  const nsvcd_pose pose = query_pose(0.2 * way[0], 0.2 * way[1], 0.2 * way[2]);
  const nsvcd_pose still = query_pose(0, 0, 0);
  memset(&counted, 0, sizeof counted);
  const nsvcd_answer answer = query_ask(small, &pose, 1, large, &still, NULL);
  printf("  %zu numbers read on a ray past %zu triangles\n", counted.numbers, mesh.triangle_count);
  CHECK_EQ(status_of(&answer), STATUS_INSIDE);
  CHECK_GE(counted.numbers, 500);  // or the ray is not where it should be
  CHECK_LE(counted.numbers, 4 * mesh.triangle_count);
  nsvcd_body_free(large, NULL);
  nsvcd_body_free(small, NULL);
  nsvcd_mesh_free(&mesh, NULL);
  nsvcd_mesh_free(&speck, NULL);
  shapes_free(&shape);
}

// ------------------------------------------------------------------------------------------- stack

#define COST_STACK (256 * 1024)
#define COST_PAINT 0xa5
// bytes that a proof may take: gcc 12 makes it 3.7 to 5.6 KB, by -march and -O
#define COST_MOST_STACK 6144

// A thread that asks for proofs, and nothing else, or for nothing.
typedef struct cost_asker {
  const nsvcd_body *bodies[2];
  nsvcd_pose motion[QUERY_POSES], fixed_pose;
  nsvcd_question question;
  void *workspace;
  nsvcd_answer answer;
  int asks;
} cost_asker;

static void *cost_ask(void *argument) {
  cost_asker *a = (cost_asker *)argument;
  if (a->asks) {
    a->question =
        question_of(a->bodies[0], a->motion, QUERY_POSES, a->bodies[1], &a->fixed_pose, NULL);
    nsvcd_sweep(&a->question, a->workspace, nsvcd_sweep_workspace_size(NULL), &a->answer);
  }
  return NULL;
}

// Bytes of a painted stack that such a thread leaves a trace on.
static size_t cost_stack_of(cost_asker *asker, unsigned char *stack) {
  pthread_attr_t attributes;
  pthread_t thread;
  memset(stack, COST_PAINT, COST_STACK);
  CHECK_EQ(pthread_attr_init(&attributes), 0);
  CHECK_EQ(pthread_attr_setstack(&attributes, stack, COST_STACK), 0);
  CHECK_EQ(pthread_create(&thread, &attributes, cost_ask, asker), 0);
  pthread_join(thread, NULL);
  pthread_attr_destroy(&attributes);
  size_t untouched = 0;
  while (untouched < COST_STACK && stack[untouched] == COST_PAINT) untouched++;
  return COST_STACK - untouched;
}

// A motion that passes the fixed body at a gap, or presses into it, so that every part of a proof
// has its turn.
static void cost_stack_is_bounded(void) {
  static cost_asker asker;
  void *stack;
  size_t most = 0;
  size_t statuses[STATUS_UNDECIDED + 1] = {0};
  asker.workspace = query_workspace();
  asker.fixed_pose = query_pose(0, 0, 0);
  CHECK_EQ(posix_memalign(&stack, 4096, COST_STACK), 0);
  const size_t idle = cost_stack_of(&asker, (unsigned char *)stack);
  asker.asks = 1;
  for (uint64_t seed = 1; seed <= 60; seed++) {
    shapes_rng rng = {seed};
    query_scene scene;
    nsvcd_mesh mesh = query_solid(seed, 0.2);
    CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &asker.bodies[0]), NSVCD_OK);
    asker.bodies[1] = asker.bodies[0];
    memset(&scene, 0, sizeof scene);
    query_scene_motion(&scene, &rng);
    for (size_t i = 0; i < QUERY_POSES; i++) {
      const double t = (double)i / (QUERY_POSES - 1);
      asker.motion[i] = scene.motion[i];
      if (seed % 3 == 0) continue;
      asker.motion[i] = query_pose(0.15 + 0.001 * (double)seed, 0.05 * t, 0.02);
      query_multiply(scene.motion[i].rotation, asker.motion[0].rotation, asker.motion[i].rotation);
    }
    // once before, for a function of libm that is called first is looked up, on the stack
    cost_ask(&asker);
    const size_t used = cost_stack_of(&asker, (unsigned char *)stack) - idle;
    most = used > most ? used : most;
    statuses[status_of(&asker.answer)]++;
    nsvcd_body_free(asker.bodies[0], NULL);
    nsvcd_mesh_free(&mesh, NULL);
  }
  printf("  at most %zu bytes of stack; %zu witnesses, %zu free\n", most, statuses[STATUS_WITNESS],
         statuses[STATUS_CERTIFIED_FREE]);
  CHECK_GE(statuses[STATUS_WITNESS], 5);
  CHECK_GE(statuses[STATUS_CERTIFIED_FREE], 5);
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && !defined(__SANITIZE_ADDRESS__)
  CHECK_GE(COST_MOST_STACK, most);
#endif
  free(stack);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// Counted, not timed, so that it holds on every machine: random scenes, and bodies made to meet in
// every test.
static void cost_is_bounded(void) {
  const nsvcd_model models[3] = {NSVCD_MODEL_TINY, NSVCD_MODEL_SMALL, NSVCD_MODEL_BASE};
  const size_t pairs[4] = {1, 3, 8, NSVCD_MAX_PAIRS};
  size_t most_ranked = 0;
  size_t most_judged = 0;
  double fraction = 0;
  for (uint64_t seed = 1; seed <= 150; seed++) {
    query_scene s;
    query_scene_open(&s, seed);
    const size_t groups = nsvcd__body_groups(s.moving) * nsvcd__body_groups(s.fixed);
    if (seed > 30) {
      cost_blow_up(&s.memory[0], seed > 120 ? 100 : 1.5f);
      cost_blow_up(&s.memory[1], seed > 120 ? 100 : 1.5f);
    }
    memset(&counted, 0, sizeof counted);
    const size_t segments = cost_search(&s);
    const size_t bound = 18 * segments * groups + 3 * segments;
    CHECK_GE(bound, counted.slices / COST_ALL);
    fraction = fmax(fraction, (double)counted.slices / COST_ALL / (double)bound);
    for (size_t n = 0; n < 12; n++) {
      const size_t k = pairs[n / 3];
      nsvcd_question options = query_options(k, models[n % 3], seed % 2 ? 0.9999f : 0);
      options.network.inflate = seed % 4 ? 1.0f : 0.0f;  // 1: planes part nothing
      memset(&counted, 0, sizeof counted);
      query_ask(s.moving, s.motion, QUERY_POSES, s.fixed, &s.fixed_pose, &options);
      CHECK_GE(bound + 18 * segments, counted.slices / COST_ALL);  // the first pair of groups twice
      CHECK_GE(n % 3 == 0 ? 3 * k : 12 * k, counted.ranked);
      CHECK_GE(n % 3 == 0 ? 0 : k, counted.judged);
      if (k != 8) continue;
      most_ranked = counted.ranked > most_ranked ? counted.ranked : most_ranked;
      most_judged = counted.judged > most_judged ? counted.judged : most_judged;
    }
    query_scene_close(&s);
  }
  printf("  of the bound: %.0f %% of the tests, %zu of 96 pairs ranked, %zu of 8 judged\n",
         100 * fraction, most_ranked, most_judged);
  CHECK_GE(fraction, 0.8);  // else the bound says little, or the worst case is not here
  CHECK_GE(most_ranked, 48);
  CHECK_EQ(most_judged, 8);
}

// An answer of a batch is nsvcd_sweep's, or a clear collision, and nearly always both are.
static void cost_batch_agrees_with_single_queries(void) {
  size_t same = 0;
  size_t otherwise = 0;
  size_t parted = 0;
  size_t hits = 0;
  static cost_batch b;
  for (uint64_t seed = 1; seed <= 30; seed++) {
    cost_open(&b, seed);
    for (int model = NSVCD_MODEL_TINY; model <= NSVCD_MODEL_BASE; model++) {
      const nsvcd_question options = query_options(0, (nsvcd_model)model, seed % 2 ? 0 : 0.999f);
      memset(b.batch, 0xff, sizeof b.batch);
      CHECK_EQ(cost_ask_batch(&b, &options, query_workspace(), b.batch), NSVCD_OK);
      for (size_t m = 0; m < COST_MOTIONS; m++) {
        const nsvcd_answer one = query_ask(b.scene.moving, b.poses + m * QUERY_POSES, QUERY_POSES,
                                           b.scene.fixed, &b.scene.fixed_pose, &options);
        hits += collides_of(&one) != 0;
        if (query_same_answer(&one, &b.batch[m])) {
          same++;
          continue;
        }
        otherwise++;
        CHECK(collides_of(&b.batch[m]) && logit_of(&b.batch[m]) >= NSVCD__CLEAR_LOGIT);
        // a plane that parted others would have parted these two
        parted += !collides_of(&one);
      }
    }
    query_scene_close(&b.scene);
  }
  CHECK_LE(parted, 2);  // of 4,320
  printf("  %zu answers to the bit, %zu other clear collisions, %zu collisions\n", same, otherwise,
         hits);
  CHECK_GE(same, 1000);  // else this test saw only one kind
  CHECK_GE(otherwise, 100);
}

// Where the bodies change roles from one question to the next, what the one says of patches is of
// no use to the other: every answer is nsvcd_sweep's.
static void cost_batch_follows_who_moves(void) {
  static cost_batch b;
  const nsvcd_question options = query_options(0, NSVCD_MODEL_TINY, 0);
  nsvcd_question questions[COST_MOTIONS];
  size_t clear = 0;
  size_t other = 0;
  for (uint64_t seed = 1; seed <= 30; seed++) {
    cost_open(&b, seed);
    const query_scene *s = &b.scene;
    for (size_t m = 0; m < COST_MOTIONS; m++) {
      const nsvcd_pose *path = b.poses + m * QUERY_POSES;
      questions[m] =
          m % 2 ? question_of(s->moving, &s->fixed_pose, 1, s->fixed, path, &options)
                : question_of(s->moving, path, QUERY_POSES, s->fixed, &s->fixed_pose, &options);
      if (m % 2) questions[m].b.count = QUERY_POSES;
    }
    void *w = query_workspace();
    const size_t size = nsvcd_sweep_workspace_size(NULL);
    CHECK_EQ(nsvcd_sweep_batch(questions, COST_MOTIONS, w, size, b.batch), NSVCD_OK);
    for (size_t m = 0; m < COST_MOTIONS; m++) {
      nsvcd_answer one;
      CHECK_EQ(nsvcd_sweep(&questions[m], w, size, &one), NSVCD_OK);
      clear += logit_of(&one) >= NSVCD__CLEAR_LOGIT;
      other += !query_same_answer(&one, &b.batch[m]);
    }
    query_scene_close(&b.scene);
  }
  CHECK_GE(clear, 300);
  CHECK_EQ(other, 0);
}

void test_cost(void) {
  RUN(cost_threads_agree);
  RUN(cost_threads_agree_by_proof);
  RUN(cost_reads_numbers_once);
  RUN(cost_stack_is_bounded);
  // from within
  RUN(cost_is_bounded);
  RUN(cost_batch_agrees_with_single_queries);
  RUN(cost_batch_follows_who_moves);
}

CHECK_ALONE(test_cost)
