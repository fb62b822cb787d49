// In: two parts of a robot. Out: a configuration in which they meet, and one in which they do not.
//
// Configurations are drawn at random. From some of them the distance is followed down its slope
// until the parts meet, or up until they do not. A joint at its limit stays there while the slope
// leads beyond it.
#pragma once
#include "configurations.h"
#include "spans.h"

// probes that are kept
#define NSVCD__KEPT_PROBES 4
// configurations that are drawn at first
#define NSVCD__RANGE_DRAWS 64
// slopes that are followed from configurations drawn at random, down, and up, which takes longer;
// steps of each; and the share of the first step below which one ends
#define NSVCD__SLOPES_DOWN 12
#define NSVCD__SLOPES_UP 2
#define NSVCD__SLOPE_STEPS 30
#define NSVCD__LEAST_STEP 0.01
// units for a question about the distance, of which a depth takes many
#define NSVCD__ROOM_WORK 2000
// units that a question takes beside its proof, about: placing parts, and asking
#define NSVCD__QUESTION_UNITS 40

typedef struct nsvcd__ranging {
  nsvcd__span span;
  nsvcd_range_options options;
  nsvcd_range_answer answer;
  // (capacity, 2 joints + 1): boxes that are left, and the fraction that each is of all values; a
  // ring
  double *boxes;
  size_t capacity, first, count;
  // that were given up: how many, and the fraction
  size_t dropped_count;
  double dropped;
  // best first
  nsvcd__probe probes[NSVCD__KEPT_PROBES];
  size_t probe_count;
  // boxes that failed
  size_t failed;
  // units beside those that proofs took
  uint64_t units;
  uint64_t random;
  nsvcd_result result;
} nsvcd__ranging;

// ---- asking

// Is it known, is there an error, or no work left?
static int nsvcd__range_is_over(nsvcd__ranging *r) {
  const nsvcd_range_options *o = &r->options;
  if (r->result || (r->answer.has_free && r->answer.has_hit)) return 1;
  if (r->units + r->span.checker->units < o->units && (!o->stop || !o->stop(o->user)))
    return 0;
  r->answer.why = NSVCD_WHY_WORK;
  return 1;
}

// Asks as nsvcd__ask_span does. UNDECIDED if there is an error, which is in r->result.
static nsvcd_verdict nsvcd__ask_range(nsvcd__ranging *r, int is_probe, size_t along,
                                      double clearance, nsvcd_check_answer *found) {
  memset(found, 0, sizeof *found);
  r->units += NSVCD__QUESTION_UNITS;
  if (!r->result)
    r->result = nsvcd__ask_span(&r->span, is_probe, along, clearance, &r->options, found);
  return found->verdict;
}

// Asks about the two parts in the configuration span.at, and notes what is known there.
static nsvcd_verdict nsvcd__note_here(nsvcd__ranging *r) {
  nsvcd_check_answer found;
  nsvcd__span *s = &r->span;
  const size_t bytes = s->scene.joint_count * sizeof *s->at;
  nsvcd__follow(&s->scene, 1, s->at);
  (void)nsvcd__ask_range(r, 0, NSVCD_NONE, (double)r->options.clearance, &found);
  if (r->result) return NSVCD_UNDECIDED;
  if (found.verdict == NSVCD_FREE && !r->answer.has_free) {
    memcpy(r->answer.free, s->at, bytes);
    r->answer.has_free = 1;
  }
  if (found.verdict == NSVCD_HIT && !r->answer.has_hit) {
    memcpy(r->answer.hit, s->at, bytes);
    r->answer.has_hit = 1;
  }
  if (found.verdict == NSVCD_UNDECIDED) r->answer.why = found.why;
  return found.verdict;
}

// ---- slopes

// Metres: how far the parts are from coming as near as the clearance, in the configuration span.at;
// less than 0 if they do. No more than a tenth of `about` too much. Returns 0 if nothing is known.
static int nsvcd__room_here(nsvcd__ranging *r, double about, nsvcd_proximity *nearest,
                            double *room) {
  nsvcd__span *s = &r->span;
  nsvcd_checker *c = s->checker;
  const float to = (float)nsvcd__max(1e-5, nsvcd__min(1e-3, 0.1 * fabs(about)));
  const nsvcd_proximity_options o = {NSVCD_MAX_COORDINATE / 4, to, 0.1f, NSVCD__ROOM_WORK};
  r->units += NSVCD__QUESTION_UNITS;
  s->scene.pairs = c->own.pairs = s->pairs;
  nsvcd__follow(&s->scene, 1, s->at);
  c->surfaces = 0;
  c->result = NSVCD_OK;
  nsvcd__place_links(c, s->at, c->at);
  nsvcd__place_sample(c, c->at, 0);
  if (!nsvcd__proximity_of(c, 0, &o, nearest) || c->result) return 0;
  const int is_hit = nearest->verdict == NSVCD_HIT;
  *room = is_hit ? -(double)nearest->depth : (double)nearest->distance.high;
  *room -= (double)r->options.clearance;
  return 1;
}

// Moves span.at along the slope, so far that the room would change by `change`.
static int nsvcd__move_along(nsvcd__span *s, const double *slope, double change) {
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  double square = 0;
  for (size_t k = 0; k < s->joints; k++) {
    const size_t j = s->path[k];
    nsvcd__values_of(&s->scene.joints[j], &low[k], &high[k]);
    const int rises = slope[j] * change > 0;
    const int is_stuck = rises ? !(s->at[j] < high[k]) : !(s->at[j] > low[k]);
    if (is_stuck) low[k] = high[k] = s->at[j];
    square += is_stuck ? 0 : slope[j] * slope[j];
  }
  if (!(square > 0)) return 0;
  for (size_t k = 0; k < s->joints; k++) {
    const size_t j = s->path[k];
    const double to = s->at[j] + change / square * slope[j];
    s->at[j] = nsvcd__max(low[k], nsvcd__min(high[k], to));
  }
  return 1;
}

// From the configuration span.at on, down the slope of the distance until the parts meet (sign -1),
// or up until they do not (1).
static void nsvcd__follow_slope(nsvcd__ranging *r, double sign) {
  nsvcd__span *s = &r->span;
  double last[NSVCD_MAX_JOINTS];
  double room, next_room;
  double step = 1;
  nsvcd_proximity nearest, next;
  if (!nsvcd__room_here(r, 1, &nearest, &room)) return;
  for (size_t n = 0; n < NSVCD__SLOPE_STEPS && step > NSVCD__LEAST_STEP; n++) {
    memcpy(last, s->at, sizeof last);
    if (nsvcd__range_is_over(r) ||
        !nsvcd__move_along(s, nearest.slope, sign * step * (fabs(room) + 1e-3)) ||
        !nsvcd__room_here(r, room, &next, &next_room))
      return;
    if (sign * next_room > sign * room) {
      nearest = next;
      room = next_room;
      step = nsvcd__min(1, 2 * step);
      if (!(sign * room < 0)) (void)nsvcd__note_here(r);
    } else {
      memcpy(s->at, last, sizeof last);
      step *= 0.25;
    }
  }
}

// ---- draws

// Puts span.at at random values; or those that are bits of `corner` at their least or greatest.
static void nsvcd__draw_values(nsvcd__ranging *r, size_t corner) {
  nsvcd__span *s = &r->span;
  for (size_t k = 0; k < s->joints; k++) {
    double low, high;
    nsvcd__values_of(&s->scene.joints[s->path[k]], &low, &high);
    const double random = nsvcd__random(&r->random);
    const double end = s->joints < 5 ? (double)(corner >> k & 1) : random < 0.5;
    s->at[s->path[k]] = low + (corner == NSVCD_NONE ? random : end) * (high - low);
  }
}

// Tries corners of the ranges, and then configurations drawn at random.
static void nsvcd__try_draws(nsvcd__ranging *r) {
  const size_t joints = r->span.joints;
  const size_t corners = joints < 5 ? (size_t)1 << joints : 32;
  for (size_t n = 0; n < NSVCD__RANGE_DRAWS && !nsvcd__range_is_over(r); n++) {
    nsvcd__draw_values(r, n < corners ? n : NSVCD_NONE);
    (void)nsvcd__note_here(r);
  }
}

// Follows slopes from configurations drawn at random.
static void nsvcd__try_slopes(nsvcd__ranging *r, size_t count, double sign) {
  for (size_t n = 0; n < count && !nsvcd__range_is_over(r); n++) {
    nsvcd__draw_values(r, NSVCD_NONE);
    nsvcd__follow_slope(r, sign);
  }
}
