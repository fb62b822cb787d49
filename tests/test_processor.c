// Which instruction set answers. In one object for SSE2, AVX2 and AVX-512 each is asked about the
// same, and so are the public functions, which ask the best that the processor has. The Makefile
// compiles this file without -march.
#undef NSVCD_NO_DISPATCH
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "query_scene.h"

void test_processor(void);

#ifdef NSVCD__DISPATCH
typedef struct processor_set {
  const char *name;
  nsvcd__isa isa;
} processor_set;

static const processor_set processor_sets[3] = {
    {"SSE2", NSVCD__FLAGS}, {"AVX2", NSVCD__AVX2}, {"AVX-512", NSVCD__AVX512}};

// How many of them this processor has.
static size_t processor_count(void) {
  return (size_t)nsvcd__isa_at_hand() + 1;
}

// A question about two bodies with triangles and latents.
typedef struct processor_scene {
  query_scene network;
  const nsvcd_body *moving, *fixed;
  nsvcd_question question;
} processor_scene;

static const nsvcd_body *processor_body(uint64_t seed, double extent) {
  nsvcd_mesh mesh = query_solid(seed, extent);
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode(&mesh, &query_both, NULL, NULL, 0, &body), NSVCD_OK);
  nsvcd_mesh_free(&mesh, NULL);
  return body;
}

static void processor_open(processor_scene *s, uint64_t seed) {
  query_scene_open(&s->network, seed);
  s->moving = processor_body(seed, 0.2);
  s->fixed = processor_body(seed + 1000, 0.3);
  s->question = question_of(s->moving, s->network.motion, QUERY_POSES, s->fixed,
                            &s->network.fixed_pose, NULL);
}

static void processor_close(processor_scene *s) {
  nsvcd_body_free(s->moving, NULL);
  nsvcd_body_free(s->fixed, NULL);
  query_scene_close(&s->network);
}

static nsvcd_answer processor_ask(const processor_set *set, const nsvcd_question *question) {
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  const size_t size = nsvcd_sweep_workspace_size(NULL);
  CHECK_EQ(nsvcd__run_batch(set->isa, question, 1, query_workspace(), size, &answer), NSVCD_OK);
  return answer;
}

// A proof's verdict is true, whoever finds it.
static void processor_proofs_agree(void) {
  size_t hits = 0;
  size_t undecided = 0;
  for (uint64_t seed = 1; seed <= 60; seed++) {
    processor_scene s;
    processor_open(&s, seed);
    const nsvcd_answer first = processor_ask(&processor_sets[0], &s.question);
    hits += collides_of(&first) != 0;
    undecided += status_of(&first) == STATUS_UNDECIDED;
    for (size_t n = 1; n < processor_count(); n++) {
      const nsvcd_answer answer = processor_ask(&processor_sets[n], &s.question);
      CHECK_EQ(status_of(&answer), status_of(&first));
      CHECK_EQ(collides_of(&answer), collides_of(&first));
    }
    processor_close(&s);
  }
  CHECK_EQ(undecided, 0);
  CHECK_GE(hits, 10);
  CHECK_LE(hits, 50);
}

// Each rounds in its own way: the network's logits are nearly the same, its gradients too.
static float processor_worst_logit(nsvcd_precision precision) {
  float worst = 0;
  for (uint64_t seed = 1; seed <= 60; seed++) {
    processor_scene s;
    processor_open(&s, seed);
    s.question.method = NSVCD_METHOD_NETWORK;
    s.question.network.model = NSVCD_MODEL_TINY;  // no other decoder is asked
    s.question.network.precision = precision;
    const nsvcd_answer first = processor_ask(&processor_sets[0], &s.question);
    for (size_t n = 1; n < processor_count(); n++) {
      const nsvcd_answer answer = processor_ask(&processor_sets[n], &s.question);
      CHECK_EQ(status_of(&answer), status_of(&first));
      if (status_of(&first) == STATUS_OK)
        worst = fmaxf(worst, fabsf(logit_of(&answer) - logit_of(&first)));
    }
    processor_close(&s);
  }
  return worst;
}

static void processor_networks_agree(void) {
  const float floats = processor_worst_logit(NSVCD_PRECISION_FLOAT);
  const float bytes = processor_worst_logit(NSVCD_PRECISION_INT8);
  printf("  logits of different instruction sets differ by %.2g at most, in bytes by %.2g\n",
         (double)floats, (double)bytes);
  CHECK_LE(floats, 1e-4);
  CHECK_LE(bytes, 0.1);  // a value may be rounded to another byte
}

// The public functions ask the best one at hand: their answers are its, to the bit.
static void processor_the_best_answers(void) {
  const processor_set *best = &processor_sets[processor_count() - 1];
  printf("  this processor: %s\n", best->name);
  size_t different = 0;
  for (uint64_t seed = 1; seed <= 30; seed++) {
    processor_scene s;
    nsvcd_answer answer;
    float one[6 * QUERY_POSES];
    float other[6 * QUERY_POSES];
    processor_open(&s, seed);
    s.question.method = NSVCD_METHOD_NETWORK;
    const size_t size = nsvcd_sweep_workspace_size(&s.question);
    CHECK_EQ(nsvcd_sweep(&s.question, query_workspace(), size, &answer), NSVCD_OK);
    const nsvcd_answer expected = processor_ask(best, &s.question);
    CHECK(query_same_answer(&answer, &expected));
    const nsvcd_answer least = processor_ask(&processor_sets[0], &s.question);
    different += !query_same_answer(&answer, &least);

    nsvcd_answer by_best;
    CHECK_EQ(nsvcd_sweep_gradient(&s.question, query_workspace(), size, &answer, one, NULL),
             NSVCD_OK);
    CHECK_EQ(
        nsvcd__run_gradient(best->isa, &s.question, query_workspace(), size, &by_best, other, NULL),
        NSVCD_OK);
    CHECK(memcmp(one, other, sizeof one) == 0);
    processor_close(&s);
  }
  // else this test could not fail
  if (processor_count() > 1) CHECK_GE(different, 1);
}

// Each computes rightly; and the public function asks the best.
static void processor_self_tests(void) {
  for (size_t n = 0; n < processor_count(); n++)
    CHECK_EQ(nsvcd__run_self_test(processor_sets[n].isa), NSVCD_OK);
  int failed = 0;
  for (int n = 0; n < 100; n++) failed += nsvcd_self_test() != NSVCD_OK;
  CHECK_EQ(failed, 0);
}

void test_processor(void) {
  RUN(processor_self_tests);
  RUN(processor_proofs_agree);
  RUN(processor_networks_agree);
  RUN(processor_the_best_answers);
}
#else
void test_processor(void) {
  printf("processor: the compiler's flags leave nothing to choose: not tested\n");
}
#endif

CHECK_ALONE(test_processor)
