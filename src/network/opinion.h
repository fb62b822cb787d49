// In: a task. Out: the network's opinion: candidates, ranked, and a logit for the best of them.
#pragma once
#include "../task/task.h"
#include "../search/search.h"
#include "decoder.h"
#include "winding_number.h"

#ifndef NSVCD_NO_NETWORK
// Scores `count` candidates, 1 to 16, by a decoder.
static void nsvcd__decode(const nsvcd__task *task, nsvcd__candidate *const *candidates,
                          size_t count, const nsvcd__decoder *decoder) {
  for (size_t first = 0; first < count; first += NSVCD__ROWS) {
    const size_t left = count - first;
    const size_t rows = left < NSVCD__ROWS ? left : NSVCD__ROWS;
    // The layers take ROW_STEP rows at a time.
    const size_t unused = nsvcd__round_up(rows, NSVCD__ROW_STEP) - rows;
#if NSVCD__ROWS > 1
    float x[NSVCD__ROWS * NSVCD__DECODER_IN];
#else
    float *x = task->row;
#endif
    float out[NSVCD__ROWS][NSVCD__DECODER_OUT];
    for (size_t l = 0; l < rows; l += NSVCD__SLICE) {
      const size_t size = rows - l < NSVCD__SLICE ? rows - l : NSVCD__SLICE;
      nsvcd__pairs pairs;
      nsvcd__pairs_of(task->moving, task->fixed, &task->motion, candidates + first + l, size,
                      &pairs);
      nsvcd__invariants(&pairs, size, x + NSVCD__DECODER_IN * l);
    }
    memset(x + NSVCD__DECODER_IN * rows, 0, unused * NSVCD__DECODER_IN * sizeof *x);
    nsvcd__decoder_run(decoder, x, rows, task->settings.int8, out);
    for (size_t k = 0; k < rows; k++) {
      candidates[first + k]->score = out[k][NSVCD__OUT_LOGIT];
      candidates[first + k]->apart = out[k][NSVCD__OUT_DISTANCE];
    }
  }
}

// Scores candidates that have no score yet, `most` at most: roughly the deeper ones, with which a
// heap ends. Returns 0, and does nothing, if there are fewer than `least`.
static int nsvcd__score(const nsvcd__task *task, nsvcd__candidates *kept, size_t least,
                        size_t most) {
  nsvcd__candidate *batch[NSVCD__BATCH];
  size_t count = 0;
  size_t left = 0;
  for (size_t k = 0; k < kept->count; k++) left += kept->items[k].score <= NSVCD__NO_SCORE;
  if (left < least || left == 0) return 0;
  left = left < most ? left : most;
  for (size_t k = kept->count; left > 0; k--) {
    nsvcd__candidate *c = &kept->items[k - 1];
    if (c->score > NSVCD__NO_SCORE) continue;
    batch[count++] = c;
    if (count < NSVCD__BATCH && count < left) continue;
    nsvcd__decode(task, batch, count, task->settings.ranker);
    left -= count;
    count = 0;
  }
  return 1;
}

// The sum of the radii of a candidate's patches, metres.
static float nsvcd__candidate_radius(const nsvcd__task *task, const nsvcd__candidate *c) {
  const float own = task->motion.scale * nsvcd__body_r(task->moving)[c->moving];
  return task->motion.unit * (own + nsvcd__body_r(task->fixed)[c->fixed]);
}

// Answers with a candidate that this decoder has scored.
static void nsvcd__answer_with(const nsvcd__task *task, const nsvcd__candidate *c,
                               const nsvcd__decoder *decoder, nsvcd_opinion *out) {
  out->logit = c->score - task->settings.threshold;
  out->distance = 0.1f * c->apart * nsvcd__candidate_radius(task, c);
  out->time = c->t_least;
  out->patch_a = c->moving;
  out->patch_b = c->fixed;
  if (task->decisive) {
    task->decisive->candidate = *c;
    task->decisive->decoder = decoder;
  }
}

// Is a distance asked for? Then the nearest candidate decides, not the most suspicious, and nothing
// is clear before all candidates are known.
static int nsvcd__of_distance(const nsvcd__task *task) {
  return task->question->ask == NSVCD_ASK_DISTANCE;
}

// The candidate with the greatest closeness decides.
static float nsvcd__closeness(const nsvcd__task *task, const nsvcd__candidate *c) {
  if (!nsvcd__of_distance(task)) return c->score;
  return -c->apart * nsvcd__candidate_radius(task, c);
}

// Is a candidate clearly no collision, by the tiny decoder?
static int nsvcd__is_harmless(const nsvcd__candidate *c, float threshold) {
  return c->score < (threshold < 0 ? threshold : 0) - NSVCD__CLEAR_LOGIT;
}

// Is the most suspicious of the candidates scored so far clearly a collision, by this logit, or, if
// they are all, clearly none? Then that is the answer, and no other decoder is needed.
static int nsvcd__is_clear(const nsvcd__task *task, const nsvcd__candidates *kept, int all,
                           float logit, nsvcd_opinion *out) {
  const float threshold = task->settings.threshold;
  if (nsvcd__of_distance(task)) return 0;
  const nsvcd__candidate *most = &kept->items[0];
  for (size_t k = 1; k < kept->count; k++)
    most = kept->items[k].score > most->score ? &kept->items[k] : most;
  const int yes = most->score > logit + (threshold > 0 ? threshold : 0);
  const int no = all && nsvcd__is_harmless(most, threshold);
  if (yes || no) nsvcd__answer_with(task, most, task->settings.ranker, out);
  return yes || no;
}

// The chosen decoder judges the K most suspicious of the scored candidates, but for harmless ones,
// a portion at a time, until one is clearly positive.
static void nsvcd__judge(const nsvcd__task *task, nsvcd__candidates *kept,
                         nsvcd_opinion *out) {
  const nsvcd__settings *settings = &task->settings;
  nsvcd__candidate *items = kept->items;
  size_t count = kept->count < settings->pairs ? kept->count : settings->pairs;
  // sorts the highest scores to the front
  for (size_t k = 0; k < count; k++) {
    size_t best = k;
    for (size_t i = k + 1; i < kept->count; i++) {
      const float here = nsvcd__closeness(task, &items[i]);
      const float d = here - nsvcd__closeness(task, &items[best]);
      if (d > 0 || (d >= 0 && nsvcd__is_shallower(&items[best], &items[i]))) best = i;
    }
    const nsvcd__candidate first = items[best];
    items[best] = items[k];
    items[k] = first;
  }
  const int all = nsvcd__of_distance(task);
  float most = -HUGE_VALF;
  while (!all && count > 1 && nsvcd__is_harmless(&items[count - 1], settings->threshold))
    count--;
  for (size_t first = 0; first < count; first += NSVCD__PORTION) {
    if (!all && !(out->logit < NSVCD__CLEAR_LOGIT)) break;
    nsvcd__candidate *portion[NSVCD__PORTION] = {NULL};
    const size_t left = count - first;
    const size_t size = left < NSVCD__PORTION ? left : NSVCD__PORTION;
    for (size_t k = 0; k < size; k++) portion[k] = &items[first + k];
    if (settings->decoder != settings->ranker)
      nsvcd__decode(task, portion, size, settings->decoder);
    for (size_t k = 0; k < size; k++) {
      const float closeness = nsvcd__closeness(task, portion[k]);
      if (!(closeness > most)) continue;
      most = closeness;
      nsvcd__answer_with(task, portion[k], settings->decoder, out);
    }
  }
}

// Does a motion that has been cut clearly collide where the hint says?
static NSVCD__NOINLINE int nsvcd__collides_again(nsvcd__query *query, const nsvcd__hint *hint,
                                                 nsvcd_opinion *out) {
  const nsvcd__task *task = &query->task;
  const nsvcd__settings *settings = &task->settings;
  nsvcd__candidates kept;
  nsvcd__candidates_start(&kept, query->kept, NSVCD__PORTION);
  nsvcd__plane_cache_begin(&query->broad_phase, settings->inflate);
  nsvcd__search_patch(&query->broad_phase, task->moving, hint->moving / NSVCD__GROUP,
                      task->fixed, hint->fixed, &kept);
  if (!nsvcd__score(task, &kept, 1, kept.count)) return 0;
  out->candidates = kept.total;
  out->limited = kept.total > settings->pairs;
  if (nsvcd__is_clear(task, &kept, 0, NSVCD__CLEAR_LOGIT, out)) return 1;
  if (settings->decoder == settings->ranker) return 0;
  nsvcd__judge(task, &kept, out);
  return out->logit >= NSVCD__CLEAR_LOGIT;
}

// Searches a motion that has been cut, and judges pairs as they are found, until one is clear or
// all are known.
static NSVCD__NOINLINE void nsvcd__search_and_judge(nsvcd__query *query, nsvcd_opinion *out) {
  const nsvcd__task *task = &query->task;
  const size_t shortlist = task->settings.shortlist;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__candidates kept;
  size_t worth = shortlist < NSVCD__FIRST_BATCH ? shortlist : NSVCD__FIRST_BATCH;
  size_t left = NSVCD__RANKED_TWICE * shortlist;
  int clear = 0;
  nsvcd__plane_cache_begin(search, task->settings.inflate);
  int more = nsvcd__search_begin(task->moving, task->fixed, ~(uint64_t)0, search);
  if (more && !nsvcd__of_distance(task)) {
    // A deep collision shows in the first pair of groups. Planes, which would take most of the
    // time, are not asked there.
    nsvcd__candidates_start(&kept, query->kept, worth);
    const int balls_only = search->cache->balls_only;
    search->cache->balls_only = 1;
    nsvcd__search_pair(search, &kept);
    search->cache->balls_only = balls_only;
    if (nsvcd__score(task, &kept, worth, worth)) {
      left -= worth;
      clear = nsvcd__is_clear(task, &kept, 0, NSVCD__FIRST_CLEAR, out);
    }
  }
  if (!clear) nsvcd__candidates_start(&kept, query->kept, shortlist);
  while (more && !clear) {
    more = nsvcd__search_step(search, &kept);
    // A deep collision shows early. What is scored now is not scored again, so this costs little.
    if (!more || left < worth || !nsvcd__score(task, &kept, worth, worth)) continue;
    left -= worth;
    clear = nsvcd__is_clear(task, &kept, 0, NSVCD__CLEAR_LOGIT, out);
    if (worth == NSVCD__FIRST_BATCH) worth = NSVCD__BATCH;
  }

  out->candidates = kept.total;
  out->limited = kept.total > task->settings.pairs;
  if (clear || kept.count == 0) return;
  nsvcd__score(task, &kept, 1, kept.count);
  if (!nsvcd__is_clear(task, &kept, 1, NSVCD__CLEAR_LOGIT, out))
    nsvcd__judge(task, &kept, out);
}

// Is a part of one body inside the other at the start?
static NSVCD__NOINLINE int nsvcd__seems_contained_at_start(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *m = &task->motion;
  nsvcd__segments *first = query->broad_phase.blocks;
  const nsvcd__mat3 scaled = nsvcd__mat3_lane(first->rotation, 0);
  const nsvcd__transform pose = {nsvcd__mat3_mix(m->per_scale, &scaled, 0, &scaled),
                                 nsvcd__lane_of(first->position, 0)};
  return nsvcd__is_contained(task->moving, task->fixed, m->scale, &pose);
}

// An opinion that needs no decoder.
static void nsvcd__certain_opinion(float logit, nsvcd_opinion *out) {
  memset(out, 0, sizeof *out);
  out->asked = 1;
  out->logit = logit;
  out->distance = HUGE_VALF;
}

// Asks the network about a motion that has been prepared. hint: NULL, or that of a batch. Returns
// whether one body seems to be inside the other at the start.
static int nsvcd__ask_network(nsvcd__query *query, nsvcd__hint *hint, nsvcd_opinion *out) {
  nsvcd__task *task = &query->task;
  const int hinted = hint && hint->known && !nsvcd__of_distance(task);
  // has been checked
  (void)nsvcd__settings_of(&task->question->network, task->moving->patches,
                           task->fixed->patches, &task->settings);
  if (nsvcd__of_distance(task) && task->question->network.inflate <= 0)
    task->settings.inflate = NSVCD__INFLATE_DISTANCE;
  nsvcd__certain_opinion(-NSVCD_LOGIT_CERTAIN, out);
  query->broad_phase.balls_met = 0;
  if (nsvcd__motion_gap(&task->motion) > task->lengths) return 0;
  nsvcd__cut_motion(&task->motion, task->lengths, &query->broad_phase);
  if (!hinted || !nsvcd__collides_again(query, hint, out)) {
    nsvcd__certain_opinion(-NSVCD_LOGIT_CERTAIN, out);
    if (hinted) hint->known = ++hint->misled < NSVCD__MISLEADS;
    nsvcd__search_and_judge(query, out);
  }
  if (hint && out->logit >= NSVCD__CLEAR_LOGIT) {
    const nsvcd__hint here = {1, 0, out->patch_a, out->patch_b};
    *hint = here;
  }

  // A body inside another need not touch anything.
  if (out->logit > 0 || !nsvcd__seems_contained_at_start(query)) return 0;
  const size_t candidates = out->candidates;
  nsvcd__certain_opinion(NSVCD_LOGIT_CERTAIN, out);
  out->candidates = candidates;
  return 1;
}

#endif  // NSVCD_NO_NETWORK
