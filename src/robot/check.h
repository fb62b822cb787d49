// In: a checker and a motion of its joints. Out: is it free, as the joints make it, at all times?
//
// A motion is checked from corner to corner. Each such interval is cut into steps in which no part
// deviates by more than is allowed. One sweep asks about a pair in all steps, with the deviations
// added to the clearance. Pairs that this does not prove are asked about again in finer steps.
#pragma once
#include "allowances.h"
#include "cones.h"
#include "local_queries.h"

// how often an interval that takes more than NSVCD__MOST_STEPS may be halved
#define NSVCD__CHECK_HALVINGS 24
// steps of an interval that is not a straight line, at first
#define NSVCD__FIRST_STEPS 4
// radians or metres: no sample is put where a motion bends by less
#define NSVCD__CORNER 1e-3
// metres that a part may deviate at first; the divisor each time that pairs are asked about again;
// the last of these, by default
#define NSVCD__COARSE 2e-3
#define NSVCD__CHECK_FINER 8
#define NSVCD__FINEST 1e-5f
// units of a try to find a hit, but for the last one
#define NSVCD__HIT_TRY 200

typedef struct nsvcd__check_state {
  nsvcd_checker *checker;
  const nsvcd_joint_motion *motion;
  const nsvcd_check_options *options;
  nsvcd_check_answer *answer;
  // between samples; 0: one configuration
  size_t steps;
  int is_stopped;
} nsvcd__check_state;

// Has the caller said stop? Once that is so, it is not asked again. user: the state.
static int nsvcd__check_stops(void *user) {
  nsvcd__check_state *s = (nsvcd__check_state *)user;
  const nsvcd_check_options *o = s->options;
  if (!s->is_stopped && o->stop && o->stop(o->user)) s->is_stopped = 1;
  return s->is_stopped;
}

// ---- pairs

// Do two parts, in their local poses, come as near as the clearance?
static nsvcd_verdict nsvcd__ask_local(nsvcd__check_state *s, const nsvcd_body_pair *pair,
                                      size_t count, float clearance, size_t work,
                                      nsvcd_answer *found) {
  nsvcd_question question = nsvcd__question_of(s->checker, pair, count, work);
  question.clearance = clearance;
  if (nsvcd__check_stops(s)) {
    memset(found, 0, sizeof *found);
    found->why = NSVCD_WHY_WORK;
    return NSVCD_UNDECIDED;
  }
  s->answer->sweeps++;
  return nsvcd__ask_sweep(s->checker, &question, found);
}

// The distance that a pair is to keep.
static double nsvcd__clearance_of(const nsvcd__check_state *s, const nsvcd_body_pair *pair) {
  const nsvcd_scene *scene = s->checker->scene;
  const float *own = scene->clearances;
  return (double)s->options->clearance + (own ? (double)own[pair - scene->pairs] : 0);
}

// Does a pair, on its sweeps between samples, come as near as the clearance? For a proof the errors
// of these sweeps are added to it. range: the steps that were asked about; the times of *found are
// fractions of it.
static nsvcd_verdict nsvcd__ask_pair(nsvcd__check_state *s, const nsvcd_body_pair *pair,
                                     int is_proof, size_t work, nsvcd__step_range *range,
                                     nsvcd_answer *found) {
  nsvcd_checker *c = s->checker;
  const double kept = nsvcd__clearance_of(s, pair);
  if (!nsvcd__steps_near(c, pair, s->steps, kept, range)) return NSVCD_FREE;
  const size_t count = range->steps + 1;
  const nsvcd__dpose *const frames[2] = {nsvcd__frames_at(c, pair->a, range->first),
                                         nsvcd__frames_at(c, pair->b, range->first)};
  const nsvcd__local local = nsvcd__localize(c, pair, frames, count);
  const double errors = is_proof ? range->error + local.rounding : 0;
  const double clearance = kept + errors;
  const float rounded = clearance > 0 ? nsvcd__above(clearance) : 0;
  return nsvcd__ask_local(s, pair, count, rounded, work, found);
}

// Is the answer's pair hit in the configuration that the answer names? Then it becomes a HIT.
static int nsvcd__is_hit_there(nsvcd__check_state *s, size_t work) {
  nsvcd_checker *c = s->checker;
  nsvcd_check_answer *answer = s->answer;
  const nsvcd_body_pair *pair = &c->scene->pairs[answer->pair];
  const float clearance = (float)nsvcd__clearance_of(s, pair);
  double joints[NSVCD_MAX_JOINTS];
  nsvcd_answer found;
  nsvcd__joints_at(s->motion, c->scene->joint_count, answer->piece, answer->fraction, joints,
                   NULL);
  nsvcd__place_links(c, joints, c->at);
  answer->placed++;
  const nsvcd__local local = nsvcd__localize_at(c, pair);
  if (nsvcd__ask_local(s, pair, 1, clearance, work, &found) != NSVCD_HIT) return 0;
  answer->verdict = NSVCD_HIT;
  answer->contact = found.nearest;
  nsvcd__contact_to_world(&local, &answer->contact);
  return 1;
}

// Is a pair that is not proven hit in some configuration? Tries two: where it came nearest in its
// proof, which is *found; then where its sweeps between samples hit.
static int nsvcd__seek_hit(nsvcd__check_state *s, size_t pair, nsvcd__step_range *range,
                           nsvcd_answer *found, size_t work) {
  nsvcd_checker *c = s->checker;
  nsvcd_check_answer *answer = s->answer;
  answer->pair = pair;
  answer->why = found->why;
  for (int attempt = 0; attempt < 2; attempt++) {
    if (s->steps > 0) {
      // a sweep takes all steps to be equally long
      const double u = nsvcd__max(0, nsvcd__min(1, (double)found->nearest.time));
      const double at = (double)range->steps * u;
      const size_t step = (size_t)at < range->steps ? (size_t)at : range->steps - 1;
      const double *times = c->times + range->first + step;
      const double time = times[0] + (at - (double)step) * (times[1] - times[0]);
      answer->piece = nsvcd__piece_at(s->motion, time);
      answer->fraction = nsvcd__fraction_at(s->motion, answer->piece, time);
    }
    if (nsvcd__is_hit_there(s, work)) return 1;
    if (attempt == 0 && !s->is_stopped &&
        nsvcd__ask_pair(s, &c->scene->pairs[pair], 0, work, range, found) == NSVCD_FREE)
      return 0;
  }
  return 0;
}

// Puts a pair first in the order.
static void nsvcd__put_first(nsvcd_checker *c, size_t pair) {
  size_t at = 0;
  while (c->order[at] != pair) at++;
  for (; at > 0; at--) c->order[at] = c->order[at - 1];
  c->order[0] = (uint32_t)pair;
}

// Asks about the first `left` pairs of c->left, until one is hit. Keeps those that stay unproven,
// and returns how many they are.
static size_t nsvcd__ask_pairs(nsvcd__check_state *s, int is_last, size_t left) {
  nsvcd_checker *c = s->checker;
  const size_t work = s->options->work;
  const size_t brief = work && work < NSVCD__HIT_TRY ? work : NSVCD__HIT_TRY;
  size_t kept = 0;
  for (size_t n = 0; n < left && !c->result && !s->is_stopped; n++) {
    const size_t pair = c->left[n];
    const nsvcd_body_pair *parts = &c->scene->pairs[pair];
    nsvcd__step_range range;
    nsvcd_answer found;
    if (nsvcd__ask_pair(s, parts, 1, work, &range, &found) == NSVCD_FREE) continue;
    if (nsvcd__seek_hit(s, pair, &range, &found, is_last ? work : brief)) {
      nsvcd__put_first(c, pair);
      return left;
    }
    c->left[kept++] = (uint32_t)pair;
  }
  return kept;
}

// ---- intervals

// Samples the parts of the first `left` pairs of c->left.
static void nsvcd__take_samples(nsvcd__check_state *s, size_t steps, size_t left) {
  nsvcd_checker *c = s->checker;
  for (size_t n = 0; n < c->mover_count; n++) c->members[c->movers[n]].is_skipped = 1;
  for (size_t n = 0; n < left; n++) {
    const nsvcd_body_pair *pair = &c->scene->pairs[c->left[n]];
    c->members[pair->a].is_skipped = c->members[pair->b].is_skipped = 0;
  }
  s->steps = steps;
  nsvcd__sample(c, s->motion, steps);
  s->answer->placed += steps + 1;
}

// Notes how far parts deviate at most in each step, of the first `left` pairs of c->left where
// these are near.
static void nsvcd__note_coarse(nsvcd__check_state *s, size_t left) {
  nsvcd_checker *c = s->checker;
  memset(c->coarse, 0, s->steps * sizeof *c->coarse);
  for (size_t n = 0; n < left; n++) {
    const nsvcd_body_pair *pair = &c->scene->pairs[c->left[n]];
    nsvcd__step_range range;
    if (!nsvcd__steps_near(c, pair, s->steps, nsvcd__clearance_of(s, pair), &range)) continue;
    for (size_t k = range.first; k < range.first + range.steps; k++) {
      const double a = nsvcd__deviation_in(c, pair->a, k);
      const double b = nsvcd__deviation_in(c, pair->b, k);
      c->coarse[k] = nsvcd__max(c->coarse[k], nsvcd__max(a, b));
    }
  }
}

// From time t0 to t1, in so many steps at first; with none it is one configuration. An interval
// that takes too many steps is halved, so often at most.
static void nsvcd__check_interval(nsvcd__check_state *s, double t0, double t1, size_t steps,
                                  int halvings) {
  nsvcd_checker *c = s->checker;
  nsvcd_check_answer *answer = s->answer;
  const double finest = (double)s->options->finest;
  size_t left = 0;
  if (!nsvcd__keeps_cones(c, s->motion, t0, t1, s->options, answer)) {
    s->is_stopped |= answer->why == NSVCD_WHY_WORK;
    return;
  }
  answer->verdict = NSVCD_UNDECIDED;
  answer->piece = nsvcd__piece_at(s->motion, t0);
  answer->fraction = nsvcd__fraction_at(s->motion, answer->piece, t0);
  for (size_t n = 0; n < c->scene->pair_count; n++) {
    const size_t pair = c->order[n];
    if (!nsvcd__pair_is_allowed(c, pair, s->motion, t0, t1)) c->left[left++] = (uint32_t)pair;
  }
  for (size_t k = 0; k <= steps; k++)
    c->times[k] = k < steps ? t0 + (t1 - t0) * (double)k / (double)steps : t1;
  nsvcd__take_samples(s, steps, left);
  double allowed = NSVCD__COARSE;
  while (left > 0) {
    answer->why = NSVCD_WHY_WORK;
    // not all is sampled
    if (s->is_stopped) return;
    nsvcd__note_coarse(s, left);
    const size_t finer = nsvcd__refine_steps(c, s->steps, allowed);
    if (finer > NSVCD__MOST_STEPS) {
      const double middle = 0.5 * (t0 + t1);
      const size_t coarse = s->steps;
      if (halvings == 0 || !(middle > t0 && middle < t1)) return;
      nsvcd__check_interval(s, t0, middle, coarse, halvings - 1);
      if (answer->verdict == NSVCD_FREE)
        nsvcd__check_interval(s, middle, t1, coarse, halvings - 1);
      return;
    }
    if (finer > s->steps) nsvcd__take_samples(s, finer, left);
    const int is_last = s->steps == 0 || allowed <= finest;
    if (!s->is_stopped) left = nsvcd__ask_pairs(s, is_last, left);
    if (s->is_stopped && answer->verdict != NSVCD_HIT) answer->why = NSVCD_WHY_WORK;
    if (c->result || answer->verdict == NSVCD_HIT || s->is_stopped || (is_last && left > 0))
      return;
    allowed = nsvcd__max(allowed / NSVCD__CHECK_FINER, finest);
  }
  answer->pair = NSVCD_NONE;
  answer->verdict = NSVCD_FREE;
  answer->free_until = t1;
}

// Until when is a motion free that is not, and is free until answer->free_until at least? By halves
// of what is open, up to time `end`. The first hit that is found is the answer's.
static void nsvcd__seek_first(nsvcd__check_state *s, double end) {
  nsvcd_check_answer *answer = s->answer;
  double high = end;
  while (!s->checker->result && !s->is_stopped) {
    const nsvcd_check_answer last = *answer;
    if (last.verdict == NSVCD_HIT) {
      const double start = nsvcd__piece_start(s->motion, last.piece);
      const double time = start + last.fraction * nsvcd__piece_time(s->motion, last.piece);
      high = nsvcd__min(high, time);
    }
    const double low = last.free_until;
    const double middle = low + 0.5 * (high - low);
    if (!(high - low > s->options->to_time) || !(middle > low && middle < high)) return;
    nsvcd__check_interval(s, low, middle, NSVCD__FIRST_STEPS, NSVCD__CHECK_HALVINGS);
    if (answer->verdict == NSVCD_HIT) continue;
    const nsvcd_check_answer found = *answer;
    *answer = last;
    answer->placed = found.placed;
    answer->sweeps = found.sweeps;
    answer->free_until = found.free_until;
    if (found.verdict != NSVCD_FREE) high = middle;
  }
}

// Does the motion turn sharply where a piece begins? Then a sample belongs there.
static int nsvcd__is_corner(const nsvcd_joint_motion *motion, size_t joints, size_t piece) {
  const double before = nsvcd__piece_time(motion, piece - 1);
  const double after = nsvcd__piece_time(motion, piece);
  double jumps = 0;
  for (size_t j = 0; j < joints; j++) jumps += nsvcd__jump_at(motion, joints, piece, j);
  return !(jumps * nsvcd__min(before, after) <= NSVCD__CORNER);
}

// ---- limits

// By how much a joint may be out of its limits: rounding.
static double nsvcd__limit_error(const nsvcd_joint *joint) {
  return 1e-9 * (1 + fabs(joint->low) + fabs(joint->high));
}

// Does a curve leave the interval from low to high? Halved until all its control points are in it,
// or an end is out.
static int nsvcd__curve_leaves(const double *points, size_t degree, double low, double high,
                               int depth) {
  double half[2][NSVCD_MAX_DEGREE + 1];
  int inside = 1;
  for (size_t i = 0; i <= degree; i++) inside &= points[i] >= low && points[i] <= high;
  if (inside) return 0;
  if (depth == 0 || !(points[0] >= low && points[0] <= high)) return 1;
  if (!(points[degree] >= low && points[degree] <= high)) return 1;
  for (size_t k = 0; k < 2; k++) {
    memcpy(half[k], points, (degree + 1) * sizeof *points);
    nsvcd__cut_curve(half[k], degree, k ? 0.5 : 0, k ? 1 : 0.5);
    if (nsvcd__curve_leaves(half[k], degree, low, high, depth - 1)) return 1;
  }
  return 0;
}

// A joint that leaves its limits in a piece by more than rounding, or NSVCD_NONE.
static size_t nsvcd__joint_outside(const nsvcd_scene *scene, const nsvcd_joint_motion *motion,
                                   size_t piece) {
  double p[NSVCD_MAX_DEGREE + 1];
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    nsvcd__joint_points(motion, piece, scene->joint_count, j, p);
    const double error = nsvcd__limit_error(joint);
    if (nsvcd__curve_leaves(p, motion->degree, joint->low - error, joint->high + error, 30))
      return j;
  }
  return NSVCD_NONE;
}

// ---- a check

// Are a motion's pieces in order? Of no pieces it must be as nsvcd__motion_meant has it.
static nsvcd_result nsvcd__pieces_check(const nsvcd_joint_motion *m, size_t joints) {
  if (m->pieces && (m->degree < 1 || m->degree > NSVCD_MAX_DEGREE)) return NSVCD_ERROR_DEGREE;
  if (m->pieces > SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints)
    return NSVCD_ERROR_DEGREE;
  if (!nsvcd__are_numbers(m->points, (m->pieces * m->degree + 1) * joints))
    return NSVCD_ERROR_VALUE;
  if (m->times && !nsvcd__are_numbers(m->times, m->pieces + 1)) return NSVCD_ERROR_TIMES;
  for (size_t p = 0; p < m->pieces && m->times; p++) {
    if (!(m->times[p + 1] > m->times[p])) return NSVCD_ERROR_TIMES;
  }
  return NSVCD_OK;
}

// Is it a motion of the scene's joints?
static nsvcd_result nsvcd__motion_check(const nsvcd_scene *scene,
                                        const nsvcd_joint_motion *m) {
  const nsvcd_result result = nsvcd__pieces_check(m, scene->joint_count);
  if (result) return result;
  const int follows = nsvcd__follows(scene, m->pieces * m->degree + 1, m->points);
  return follows ? NSVCD_OK : NSVCD_ERROR_MIMIC;
}

NSVCDDEF nsvcd_result nsvcd_allowed_until(const nsvcd_checker *c,
                                          const nsvcd_allowance *allowance,
                                          const nsvcd_joint_motion *motion, int back,
                                          double *time) {
  if (!c || !allowance || !motion || !motion->points || !time) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  nsvcd_result result = nsvcd__allowance_check(c->scene, allowance);
  if (!result) result = nsvcd__motion_check(c->scene, &m);
  if (result) return result;
  const double ends[2] = {nsvcd__piece_start(&m, 0), nsvcd__piece_start(&m, m.pieces)};
  *time = nsvcd__allowed_up_to(c, allowance, &m, ends[back != 0], ends[back == 0]);
  return NSVCD_OK;
}

// Is it free, and within the limits?
static int nsvcd__proves_free(const nsvcd_check_answer *answer) {
  return answer->verdict == NSVCD_FREE && answer->joint == NSVCD_NONE;
}

NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_check_answer found;
  nsvcd_check_options o;
  if (!c || !motion || !answer || !motion->points) return NSVCD_ERROR_ARGUMENT;
  const size_t joints = c->scene->joint_count;
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  const nsvcd_result result = nsvcd__motion_check(c->scene, &m);
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_finite(o.clearance) || o.clearance < 0) return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_finite(o.finest) || o.finest < 0) return NSVCD_ERROR_FINEST;
  if (!nsvcd__are_numbers(&o.to_time, 1) || o.to_time < 0) return NSVCD_ERROR_TO;
  o.finest = o.finest > 0 ? o.finest : NSVCD__FINEST;
  memset(&found, 0, sizeof found);
  found.joint = found.pair = found.piece = found.cone = NSVCD_NONE;
  nsvcd__check_state s = {c, &m, &o, &found, 0, 0};
  int (*const stop)(void *user) = c->stop;
  void *const user = c->user;
  c->stop = o.stop ? nsvcd__check_stops : NULL;
  c->user = &s;
  for (size_t p = 0; p < m.pieces + !m.pieces && found.joint == NSVCD_NONE; p++)
    found.joint = nsvcd__joint_outside(c->scene, &m, p);
  c->result = NSVCD_OK;
  if (m.pieces == 0) nsvcd__check_interval(&s, 0, 0, 0, 0);
  if (m.pieces > 0) nsvcd__note_cuts(c, &m);
  found.free_until = nsvcd__piece_start(&m, 0);
  // from corner to corner
  for (size_t p = 0, next; p < m.pieces; p = next) {
    next = p + 1;
    while (next < m.pieces && !nsvcd__is_corner(&m, joints, next)) next++;
    const size_t steps = next - p == 1 && m.degree == 1 ? 1 : NSVCD__FIRST_STEPS;
    const double end = nsvcd__piece_start(&m, next);
    found.verdict = NSVCD_FREE;
    for (double t0 = nsvcd__piece_start(&m, p), t1; t0 < end; t0 = t1) {
      t1 = nsvcd__next_cut(c, t0, end);
      nsvcd__check_interval(&s, t0, t1, steps, NSVCD__CHECK_HALVINGS);
      if (found.verdict == NSVCD_FREE) continue;
      if (o.to_time > 0) nsvcd__seek_first(&s, t1);
      break;
    }
    if (found.verdict != NSVCD_FREE) break;
  }
  for (size_t n = 0; n < c->mover_count; n++) c->members[c->movers[n]].is_skipped = 0;
  c->stop = stop;
  c->user = user;
  if (c->result) return c->result;
  if (found.verdict == NSVCD_FREE) {
    found.piece = NSVCD_NONE;
    found.fraction = 0;
    found.why = NSVCD_WHY_NOTHING;
  }
  *answer = found;
  return NSVCD_OK;
}
