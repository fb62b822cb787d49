// In: two bodies and a motion. Out: an answer, by proof (proof/proof) or by the network
// (NeuralSVCD, algorithm 1). nsvcd_sweep stands at the end. A question goes through these phases:
//
//   check       is it in order, which method can answer it, and is the workspace large enough?
//   lay out     what it needs, and where in the workspace that is
//   who moves   of its two bodies; all is computed in the other's frame and units
//   answer      by proof, or by the network
//   write       what was found about moving and fixed, as facts about a and b
//
// A batch checks all of its questions before it answers the first one.
#pragma once
#include "../proof/proof.h"
#include "../network/decoder.h"
#include "../search/planes.h"

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
// judges the K most suspicious. K is network.pairs, NSVCD_DEFAULT_PAIRS where nothing is said. That
// a motion is cut into 16 to 64 segments stands in *broad phase*, what goes through the decoder at
// once (NSVCD__BATCH, NSVCD__ROWS) in *decoder*, and what a proof may take in *proof*.

// pairs on the shortlist, times K; of the tiny decoder, which needs none, K: nsvcd__settings_of,
// nsvcd__needs_of
#define NSVCD__SHORTLIST 4
// new pairs that are worth the first look by the ranker, before the search is done. Later looks
// wait for NSVCD__BATCH: nsvcd__search_and_judge
#define NSVCD__FIRST_BATCH 8
// pairs that such looks may take, times the shortlist: nsvcd__search_and_judge
#define NSVCD__RANKED_TWICE 2
// pairs that the chosen decoder sees at once, until one is clear: nsvcd__judge; and pairs that are
// kept where the last of a batch collided: nsvcd__collides_again
#define NSVCD__PORTION 4
// that patches swell before planes separate them, shares of their radii, at N = 32 and less the
// more there are: at a recall of 0.999, and of 0.9999
#define NSVCD__INFLATE 0.04f
#define NSVCD__MOST_INFLATE 0.1f
// and where a distance is asked for: patches are told of within their radii
#define NSVCD__INFLATE_DISTANCE 1.0f
// a logit so far from 0 is clear. A clear collision needs no second pair (nsvcd__judge), and what
// is clear to the ranker no second decoder (nsvcd__is_clear): 37,000 answers on held-out
// sets, N = 128 to 512, are the same as with twice this and the next, but for four
#define NSVCD__CLEAR_LOGIT 3.0f
// the same in the first pair of groups, where planes are not asked yet: at 3 earlier weights
// stopped one free motion of 2,000, 2 mm from contact, more; nsvcd__search_and_judge
#define NSVCD__FIRST_CLEAR 4.0f
// times that the place where the last of a batch collided may mislead before it is forgotten:
// nsvcd__answer_by_network
#define NSVCD__MISLEADS 2

// The network's options, with the defaults filled in.
typedef struct nsvcd__settings {
  size_t pairs;  // K
  // pairs that are kept
  size_t shortlist;
  const nsvcd__decoder *decoder, *ranker;
  int int8;
  // subtracted from the decoder's logit
  float threshold;
  // of patches, shares of their radii, before planes separate them
  float inflate;
} nsvcd__settings;

// The candidate that an answer is about, and the decoder that gave its logit.
typedef struct nsvcd__decisive {
  nsvcd__candidate candidate;
  const nsvcd__decoder *decoder;
} nsvcd__decisive;
#endif  // NSVCD_NO_NETWORK

// ---- tasks, and their memory

// A question that has been checked.
typedef struct nsvcd__task {
  const nsvcd_body *moving, *fixed;
  nsvcd__motion motion;
  int swapped;  // the moving body is b, not a
  // extents of both bodies, in the fixed one's units
  float lengths;
  nsvcd_method method;  // PROOF or NETWORK
  // the caller's
  const nsvcd_question *question;
#ifndef NSVCD_NO_NETWORK
  // of the network
  nsvcd__settings settings;
  // written unless NULL
  nsvcd__decisive *decisive;
#if NSVCD__ROWS == 1
  // (DECODER_IN) the decoder's inputs, in memory that the search has no need of between two groups:
  // stack is scarce where rows go one by one
  float *row;
#endif
#endif
} nsvcd__task;

// What a workspace holds, at its beginning.
typedef struct nsvcd__query {
  nsvcd__search broad_phase;
  nsvcd__task task;
  // The memory of the network and that of the proof are in one place, for one follows the other.
#ifndef NSVCD_NO_NETWORK
  // (shortlist)
  nsvcd__candidate *kept;
#endif
#ifndef NSVCD_NO_PROOF
  nsvcd__proof *proof;
  nsvcd__interval *intervals;  // (S)
#endif
} nsvcd__query;

// What NSVCD_PROOF_WORKSPACE_BYTES and NSVCD_NETWORK_WORKSPACE_BYTES count on; where this does not
// compile they are wrong.
typedef char nsvcd__constants_hold
    [sizeof(nsvcd__query) + 3 * NSVCD_ALIGNMENT + NSVCD__PASSED_OVER <= 1088 &&
             sizeof(nsvcd__segments) <= 148 * 16 && sizeof(nsvcd__chords) <= 512 &&
             sizeof(nsvcd__cut) <= 16 * 512 && NSVCD__TILE_SLOTS == 32 &&
             NSVCD_ALIGNMENT == sizeof(uint64_t)
         ? 1
         : -1];
#ifndef NSVCD_NO_PROOF
typedef char nsvcd__proof_constants_hold
    [sizeof(nsvcd__proof) <= 24832 && sizeof(nsvcd__interval) <= 168 ? 1 : -1];
#endif
#ifndef NSVCD_NO_NETWORK
typedef char
    nsvcd__network_constants_hold[NSVCD__SHORTLIST * sizeof(nsvcd__candidate) <= 112 &&
                                          sizeof(nsvcd__plane_cache) <= 576 &&
                                          NSVCD__LATENT == 40 &&
                                          sizeof(float) * NSVCD__DECODER_IN <=
                                              sizeof(uint16_t) * NSVCD__GROUP * NSVCD__LANES
                                      ? 1
                                      : -1];
#endif

// Lays a query out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes that it takes.
static size_t nsvcd__query_layout(const nsvcd__needs *needs, char *base) {
  nsvcd__query counted;
  uint64_t used = 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd__query));
  nsvcd__query *query = at ? (nsvcd__query *)at : &counted;
  nsvcd__search_layout(needs, base, &used, &query->broad_phase);
  uint64_t end = used;
#ifndef NSVCD_NO_NETWORK
  uint64_t network = used;
  void *kept = nsvcd__take(base, &network, needs->candidates, sizeof(nsvcd__candidate));
  query->kept = (nsvcd__candidate *)kept;
  const size_t asked = needs->candidates > 0;
  const size_t meetings = asked * NSVCD__GROUP * needs->segments;
  void *cache = nsvcd__take(base, &network, asked, sizeof(nsvcd__plane_cache));
  void *met = nsvcd__take(base, &network, meetings, sizeof(uint16_t));
  query->broad_phase.cache = (nsvcd__plane_cache *)cache;
  query->broad_phase.met = (uint16_t *)met;
  end = network;
#endif
#ifndef NSVCD_NO_PROOF
  uint64_t proof = used;
  const size_t intervals = needs->proof ? needs->segments : 0;
  query->proof =
      (nsvcd__proof *)nsvcd__take(base, &proof, needs->proof != 0, sizeof(nsvcd__proof));
  query->intervals =
      (nsvcd__interval *)nsvcd__take(base, &proof, intervals, sizeof(nsvcd__interval));
  end = proof > end ? proof : end;
#endif
  return (size_t)end;
}

// What is said where no more than a verdict is known: they may go to where they are in the end if
// they are free all the way, else nowhere.
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

// Where the last of a batch collided by the network: the next is asked there first. Forgotten when
// it has misled MISLEADS times, or the bodies change.
typedef struct nsvcd__hint {
  int known;
  int misled;
  // patches
  uint32_t moving, fixed;
} nsvcd__hint;
