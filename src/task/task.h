// In: two bodies and a motion. Out: an answer, by proof (proof/proof) or by the network
// (NeuralSVCD, algorithm 1). This room has what a question needs, and its memory; query/question
// takes it through these phases:
//
//   check       is it in order, which method can answer it, and is the workspace large enough?
//   who moves   of its two bodies; all is computed in the other's frame and units
//   lay out     what it needs, and where in the workspace that is
//   answer      by proof, or by the network
//   write       what was found about moving and fixed, as facts about a and b
//
// A batch checks all of its questions before it answers the first one.
#pragma once
#include "../motion/workspace.h"
#include "../proof/proof.h"
#include "facts.h"

#ifndef NSVCD_NO_NETWORK
#ifndef NSVCD_NO_BASE
#define NSVCD__LARGEST_MODEL NSVCD_MODEL_BASE
#elif !defined(NSVCD_NO_SMALL)
#define NSVCD__LARGEST_MODEL NSVCD_MODEL_SMALL
#else
#define NSVCD__LARGEST_MODEL NSVCD_MODEL_TINY
#endif

// ---- the network's schedule
//
// The search finds pairs of patches whose balls meet. The deepest of them make the shortlist. The
// ranker, which is the tiny decoder, scores these while the search goes on, and the chosen decoder
// judges the K most suspicious. K is network.pairs, by default NSVCD_DEFAULT_PAIRS. The broad phase
// says how a motion is cut, into 16 to 64 segments; network/decoder how much goes through a decoder
// at once (NSVCD__BATCH, NSVCD__ROWS); and proof/proof what a proof may take.

// Pairs on the shortlist, times K. The tiny decoder needs none: K.
#define NSVCD__SHORTLIST 4
// New pairs that are worth a first run of the ranker before the search is done. Later runs wait for
// NSVCD__BATCH pairs.
#define NSVCD__FIRST_BATCH 8
// Pairs that runs before the end of the search may take, times the shortlist.
#define NSVCD__RANKED_TWICE 2
// Pairs that the chosen decoder gets at once, until one is clear; and pairs that are kept where the
// last of a batch collided.
#define NSVCD__PORTION 4
// By how much patches are inflated before planes separate them, as a fraction of their radii, at
// N = 32, and less the more patches there are: at a recall of 0.999, and of 0.9999.
#define NSVCD__INFLATE 0.04f
#define NSVCD__MOST_INFLATE 0.1f
// The same where a distance is asked for: the decoder knows distances up to a patch's radius.
#define NSVCD__INFLATE_DISTANCE 1.0f
// A logit this far from 0 is clear. A clear collision needs no second pair, and what is clear to
// the ranker no second decoder: 37,000 answers on held-out sets, N = 128 to 512, are the same as
// with twice this and twice the next, but for four.
#define NSVCD__CLEAR_LOGIT 3.0f
// The same in the first pair of groups, where planes are not asked yet: at 3, earlier weights
// stopped one more free motion of 2,000, 2 mm from contact.
#define NSVCD__FIRST_CLEAR 4.0f
// How often the patches where the last of a batch collided may mislead before they are forgotten.
#define NSVCD__MISLEADS 2

// The network's options, with the defaults filled in.
typedef struct nsvcd__settings {
  size_t pairs;      // K
  size_t shortlist;  // pairs that are kept
  const nsvcd__decoder *decoder, *ranker;
  int int8;
  float threshold;  // subtracted from the decoder's logit
  float inflate;    // as NSVCD__INFLATE, for these bodies
} nsvcd__settings;

// The candidate that an answer is about, and the decoder that gave its logit.
typedef struct nsvcd__decisive {
  nsvcd__candidate candidate;
  const nsvcd__decoder *decoder;
} nsvcd__decisive;

// The settings for two bodies of so many patches. On an error, where the options ask for what is
// not there, *settings is not whole. weights.h has a threshold per decoder, recall and N = 32, 64,
// ..., 512. Between those, and for two bodies that differ, it is interpolated at the mean of log2
// N.
static nsvcd_result nsvcd__settings_of(const nsvcd_network_options *o, size_t patches1,
                                       size_t patches2, nsvcd__settings *settings) {
  if (o->pairs > NSVCD_MAX_PAIRS) return NSVCD_ERROR_PAIRS;
  if ((unsigned)o->model > (unsigned)NSVCD_MODEL_BASE) return NSVCD_ERROR_MODEL;
  if (!nsvcd__is_finite(o->inflate) || o->inflate < 0) return NSVCD_ERROR_INFLATE;
  if (o->precision != NSVCD_PRECISION_FLOAT && o->precision != NSVCD_PRECISION_INT8)
    return NSVCD_ERROR_PRECISION;
  const nsvcd_model model = o->model ? o->model : NSVCD__LARGEST_MODEL;
  const size_t decoder = (size_t)model - (size_t)NSVCD_MODEL_TINY;
  if (!nsvcd_w_decoders[decoder].layers) return NSVCD_ERROR_MODEL;  // compiled out
  settings->pairs = o->pairs ? o->pairs : NSVCD_DEFAULT_PAIRS;
  settings->shortlist = decoder == 0 ? settings->pairs : NSVCD__SHORTLIST * settings->pairs;
  settings->decoder = &nsvcd_w_decoders[decoder];
  settings->ranker = &nsvcd_w_decoders[0];
#ifdef NSVCD_NO_FLOAT
  settings->int8 = 1;
#else
  settings->int8 = o->precision == NSVCD_PRECISION_INT8;
#endif
#ifdef NSVCD_NO_INT8
  if (settings->int8) return NSVCD_ERROR_PRECISION;
#endif
  for (size_t k = 0; k < NSVCD_W_RECALLS && nsvcd__is_finite(o->recall); k++) {
    if (o->recall < nsvcd_w_recall[k] || o->recall > nsvcd_w_recall[k]) continue;
    const float n = sqrtf((float)patches1 * (float)patches2);
    const float last = NSVCD_W_SIZES - 1;
    const float size = log2f(n) - 5;
    const float at = size < 0 ? 0 : size > last ? last : size;
    const size_t row = at < last ? (size_t)at : NSVCD_W_SIZES - 2;
    const float low = nsvcd_w_threshold[decoder][row][k];
    const float high = nsvcd_w_threshold[decoder][row + 1][k];
    settings->threshold = low + (at - (float)row) * (high - low);
    const float least = k < 2 ? 0 : k == 2 ? NSVCD__INFLATE : NSVCD__MOST_INFLATE;
    settings->inflate = fmaxf(o->inflate, least * 32 / n);
    return NSVCD_OK;
  }
  return NSVCD_ERROR_RECALL;
}
#endif  // NSVCD_NO_NETWORK

// ---- tasks, and their memory

// A question that has been checked.
typedef struct nsvcd__task {
  const nsvcd_body *moving, *fixed;
  nsvcd__motion motion;
  int swapped;          // the moving body is b, not a
  float lengths;        // extents of both bodies and their pivots, in the fixed one's units
  nsvcd_method method;  // PROOF or NETWORK
  const nsvcd_question *question;
#ifndef NSVCD_NO_NETWORK
  nsvcd__settings settings;
  nsvcd__decisive *decisive;  // written unless NULL
#if NSVCD__SLICE == 1
  // (DECODER_IN) the decoder's inputs, in memory that the search does not need between two groups:
  // stack is scarce where rows go one by one
  float *row;
#endif
#endif
} nsvcd__task;

// What a workspace begins with. The network's memory and the proof's are the same, for one follows
// the other.
typedef struct nsvcd__query {
  nsvcd__isa isa;  // whose kernels answer
  nsvcd__search broad_phase;
  nsvcd__task task;
#ifndef NSVCD_NO_NETWORK
  nsvcd__candidate *kept;  // (shortlist)
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__solver *solver;
  nsvcd__interval *intervals;  // (S)
#endif
} nsvcd__query;

// NSVCD_PROOF_WORKSPACE_BYTES and NSVCD_NETWORK_WORKSPACE_BYTES count on these. Where this does not
// compile they are wrong.
#define NSVCD__MUST_HOLD(condition) ((condition) ? 1 : -1)
typedef char nsvcd__constants_hold[NSVCD__MUST_HOLD(
    sizeof(nsvcd__query) + 3 * NSVCD_ALIGNMENT + NSVCD__PASSED_OVER <= 1088 &&
    sizeof(nsvcd__segments) <= 148 * 16 && sizeof(nsvcd__chords) <= 512 &&
    sizeof(nsvcd__cut) <= 16 * 512 && NSVCD__TILE_SLOTS == 32 &&
    NSVCD_ALIGNMENT == sizeof(uint64_t))];
#ifndef NSVCD_NO_PROOF
typedef char nsvcd__proof_constants_hold[NSVCD__MUST_HOLD(sizeof(nsvcd__solver) <= 24832 &&
                                                          sizeof(nsvcd__interval) <= 168)];
#endif
#ifndef NSVCD_NO_NETWORK
typedef char nsvcd__network_constants_hold[NSVCD__MUST_HOLD(
    NSVCD__SHORTLIST * sizeof(nsvcd__candidate) <= 112 && NSVCD__LATENT == 40 &&
    sizeof(nsvcd__plane_cache) <= 576)];
#endif

// Lays a query out at `base`, which is aligned, or only counts if that is NULL. Returns the bytes
// that it takes.
static size_t nsvcd__query_layout(const nsvcd__needs *needs, char *base) {
  nsvcd__query counted;
  uint64_t used = 0;
  nsvcd__query *query = NSVCD__TAKE_ROWS(nsvcd__query, 1, base, &used);
  if (!query) query = &counted;
  nsvcd__search_layout(needs, base, &used, &query->broad_phase);
  uint64_t end = used;
#ifndef NSVCD_NO_NETWORK
  nsvcd__search *search = &query->broad_phase;
  const size_t asked = needs->candidates > 0;
  const size_t meetings = asked * NSVCD__GROUP * needs->segments;
  query->kept = NSVCD__TAKE_ROWS(nsvcd__candidate, needs->candidates, base, &end);
  search->cache = NSVCD__TAKE_ROWS(nsvcd__plane_cache, asked, base, &end);
  search->met = NSVCD__TAKE_ROWS(uint16_t, meetings, base, &end);
#endif
#ifndef NSVCD_NO_PROOF
  const size_t proofs = needs->proof != 0;
  const size_t intervals = proofs * needs->segments;
  query->solver = NSVCD__TAKE_ROWS(nsvcd__solver, proofs, base, &used);
  query->intervals = NSVCD__TAKE_ROWS(nsvcd__interval, intervals, base, &used);
#endif
  return (size_t)(used > end ? used : end);
}

// Writes what a verdict alone tells: the bodies may go to the end of a motion that is free, else
// nowhere.
static void nsvcd__answer_begin(const nsvcd__task *task, nsvcd_verdict verdict,
                                nsvcd_answer *answer) {
  const nsvcd__track *moving = &task->motion.moving;
  const nsvcd__track *fixed = &task->motion.fixed;
  const int is_free = verdict == NSVCD_FREE;
  memset(answer, 0, sizeof *answer);
  answer->verdict = verdict;
  answer->time.low = answer->safe.time = is_free ? 1.0f : 0.0f;
  answer->time.high = is_free ? 1 : HUGE_VALF;
  answer->distance.high = HUGE_VALF;
  answer->depth = is_free ? 0 : HUGE_VALF;
  answer->safe.a = moving->poses[is_free ? moving->count - 1 : 0];
  answer->safe.b = fixed->poses[is_free ? fixed->count - 1 : 0];
  answer->nearest.gap = HUGE_VALF;
  answer->nearest.triangle_a = NSVCD_NO_TRIANGLE;
  answer->nearest.triangle_b = NSVCD_NO_TRIANGLE;
}

// Where the last question of a batch collided, by the network: the next one is tried there first.
// Forgotten when it has misled MISLEADS times, or the bodies change.
typedef struct nsvcd__hint {
  int known, misled;
  uint32_t moving, fixed;  // patches
} nsvcd__hint;
