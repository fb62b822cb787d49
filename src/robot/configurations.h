// In: a robot in one configuration. Out: pairs that are near, and how that changes with the joints;
// a configuration near by that is free; which pairs can meet.
#pragma once
#include "../interface/configurations.h"
#include "rrt.h"

#define NSVCD__GAP_WITHIN 0.05f
#define NSVCD__GAP_TO 2e-5f
#define NSVCD__GAP_DEEPEST 0.02f
// of `deepest`: the first slop that is tried; and how often a push-out is halved
#define NSVCD__LEAST_SLOP 0.015625f
#define NSVCD__DEPTH_HALVINGS 12
// of the depth: what is looked at to see which faces part last; and the least share of a push-out
// that separates them, of which a slope is told
#define NSVCD__DEPTH_BEYOND 1.01
#define NSVCD__LEAST_RATE 0.1
#define NSVCD__FARTHEST_FREE 0.5
// metres that an escape leaves beside the clearance, so that a route can begin there
#define NSVCD__FREE_ROOM 5e-4f
// spheres about the joints that random configurations are drawn on, and how many on each; how much
// nearer than the best the next is drawn; halvings of the way back
#define NSVCD__FREE_RINGS 8
#define NSVCD__FREE_DRAWS 64
#define NSVCD__FREE_NEARER 0.9
#define NSVCD__FREE_HALVINGS 10
#define NSVCD__PAIR_SAMPLES 64

static nsvcd_result nsvcd__check_joints(const nsvcd_checker *checker, const double *joints) {
  if (!checker || !joints) return NSVCD_ERROR_ARGUMENT;
  for (size_t j = 0; j < checker->scene->joint_count; j++) {
    if (!nsvcd__is_number(joints[j], (double)NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_VALUE;
  }
  return NSVCD_OK;
}

// Places all parts where the joints say, as the first of their samples.
static void nsvcd__set_configuration(nsvcd_checker *c, const double *joints) {
  memcpy(c->at.joints, joints, c->scene->joint_count * sizeof *joints);
  nsvcd__pose_links(c, &c->at);
  nsvcd__sample_put(c, &c->at, 0);
}

// Of two parts where they stand.
static nsvcd_question nsvcd__ask_configuration(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                               size_t work, nsvcd__sight *view) {
  const nsvcd__frame *const frames[2] = {nsvcd__frames_at(c, pair->a, 0),
                                         nsvcd__frames_at(c, pair->b, 0)};
  nsvcd__view_pair(c, pair, frames, 1, view);
  return nsvcd__question_of(c, pair, 1, work);
}

// ---- gaps

// How the point of a part that is seen at `at` now moves along a normal, by each joint: added to
// the slope, times `sign`.
static void nsvcd__slope_add(const nsvcd_checker *c, size_t part, const nsvcd__sight *view,
                             nsvcd__d3 at, nsvcd__d3 along, double sign, double *slope) {
  const nsvcd__d3 point = nsvcd__seen_point(view, at);
  const nsvcd__d3 normal = nsvcd__seen_direction(view, along);
  const uint32_t link = c->scene->parts[part].link;
  for (uint32_t path = link ? c->links[link - 1].path : 0; path; path &= path - 1) {
    const size_t j = nsvcd__low_bit(path);
    const nsvcd__d3 arm = nsvcd__d3_sub(point, c->at.frames[j + 1].position);
    const nsvcd__d3 speed =
        nsvcd__slides(c, j) ? c->at.axes[j] : nsvcd__d3_cross(c->at.axes[j], arm);
    slope[j] += sign * nsvcd__d3_dot(normal, speed);
  }
}

// Asks a question with a pushed out by so much.
static nsvcd_result nsvcd__ask_lifted(nsvcd_checker *c, const nsvcd_question *question,
                                      nsvcd__d3 push_out, nsvcd_answer *found) {
  nsvcd_pose pushed_out = *question->a.poses;
  nsvcd_question asked = *question;
  const nsvcd__d3 position = nsvcd__d3_add(nsvcd__d3_load(pushed_out.position), push_out);
  asked.a.poses = &pushed_out;
  nsvcd__f3_store(nsvcd__f3_round(position), pushed_out.position);
  return nsvcd_sweep(&asked, c->query, c->query_size, found);
}

// A push-out of a off b that separates them, by the least of some slops, each four times the one
// before, that is enough. 0: none up to `deepest` is.
static nsvcd_result nsvcd__separating_push_out(nsvcd_checker *c, nsvcd_question question,
                                               float deepest, nsvcd__d3 *push_out) {
  nsvcd_answer found;
  for (float fraction = NSVCD__LEAST_SLOP; fraction <= 1; fraction *= 4) {
    question.slop = fraction * deepest;
    const nsvcd_result result = nsvcd_sweep(&question, c->query, c->query_size, &found);
    if (result) return result;
    *push_out = nsvcd__d3_load(found.push_out);
    if (found.verdict == NSVCD_FREE) return NSVCD_OK;
  }
  *push_out = nsvcd__d3_of(0, 0, 0);
  return NSVCD_OK;
}

// Of parts that touch: how deep, where, along which normal, and how that shrinks. question: with
// all that poses are off as its clearance.
static nsvcd_result nsvcd__touching_gap(nsvcd_checker *c, nsvcd_question question,
                                        const nsvcd__sight *view,
                                        const nsvcd_proximity_options *o,
                                        nsvcd_proximity *gap) {
  const nsvcd_body_pair *both = &c->scene->pairs[gap->pair];
  nsvcd_answer found;
  nsvcd__d3 push_out = {0, 0, 0};
  double low = 0;  // share of the push-out: they touch there; and they do not
  double high = 1;
  question.ask = NSVCD_ASK_HIT;
  question.to = 0;
  nsvcd_result result = nsvcd__separating_push_out(c, question, o->deepest, &push_out);
  const double length = nsvcd__d3_length(push_out);
  if (result || !(length > 0)) return result;
  for (size_t n = 0; n < NSVCD__DEPTH_HALVINGS && !result; n++) {
    const double middle = 0.5 * (low + high);
    result = nsvcd__ask_lifted(c, &question, nsvcd__d3_scale(push_out, middle), &found);
    *(!result && found.verdict == NSVCD_FREE ? &high : &low) = middle;
  }
  if (result) return result;
  // a little beyond, which faces are near
  const double beyond = NSVCD__DEPTH_BEYOND * high + (double)o->to / length;
  question.clearance = 0;
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = 0.1f * o->to;
  result = nsvcd__ask_lifted(c, &question, nsvcd__d3_scale(push_out, beyond), &found);
  if (result) return result;
  const nsvcd__d3 along = nsvcd__d3_scale(push_out, 1 / length);
  const nsvcd__d3 normal = nsvcd__d3_load(found.nearest.normal);
  const nsvcd__d3 point = nsvcd__d3_load(found.nearest.point);
  gap->depth = nsvcd__above(high * length);
  gap->contact = found.nearest;
  gap->contact.gap = 0;
  nsvcd__f3_store(nsvcd__f3_round(along), gap->contact.normal);
  nsvcd__set_contact(view, &gap->contact);
  // a push-out parts the two faces slower than it goes, unless it is along their normal
  const double rate = nsvcd__d3_dot(along, normal);
  if (!(rate > NSVCD__LEAST_RATE)) return NSVCD_OK;
  const nsvcd__d3 on_a = nsvcd__d3_fma(-high, push_out, point);
  nsvcd__slope_add(c, both->a, view, on_a, normal, 1 / rate, gap->slope);
  nsvcd__slope_add(c, both->b, view, point, normal, -1 / rate, gap->slope);
  return NSVCD_OK;
}

// The gap of a pair where it stands. *is_near: it is within.
static nsvcd_result nsvcd__gap_of(nsvcd_checker *c, size_t pair,
                                  const nsvcd_proximity_options *o, nsvcd_proximity *gap,
                                  int *is_near) {
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  const nsvcd__member *members[2] = {&c->members[both->a], &c->members[both->b]};
  nsvcd_answer found;
  nsvcd__sight view;
  const double frames_off = 2 * (members[0]->rounding + members[1]->rounding);
  const double max_distance = (double)o->max_distance + frames_off;
  *is_near = 0;
  if (nsvcd__boxes_apart(&members[0]->box, &members[1]->box, 1.000001 * max_distance))
    return NSVCD_OK;
  nsvcd_question question = nsvcd__ask_configuration(c, both, o->work, &view);
  // places are off by so much, at most, and a push-out that is told in floats
  const double off = frames_off + view.rounding;
  const float deepest_off = nsvcd__above(off + 2e-7 * (double)o->deepest);
  question.clearance = nsvcd__above((double)o->max_distance + off);
  nsvcd_result result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result || found.verdict == NSVCD_FREE) return result;
  question.clearance = 0;
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = o->to;
  result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result) return result;
  *is_near = 1;
  memset(gap, 0, sizeof *gap);
  gap->pair = pair;
  gap->verdict = found.verdict;
  gap->why = found.why;
  gap->contact = found.nearest;
  if (found.verdict == NSVCD_HIT) {
    nsvcd__set_contact(&view, &gap->contact);
    gap->distance.high = nsvcd__above(off);
    gap->depth = HUGE_VALF;
    question.clearance = deepest_off;
    return found.inside ? NSVCD_OK : nsvcd__touching_gap(c, question, &view, o, gap);
  }
  gap->distance.high = nsvcd__above((double)found.distance.high + off);
  gap->distance.low = (float)nsvcd__max((double)found.distance.low * (1 - 1e-7) - off, 0);
  // of both at the point on b: that on a is off it along the normal, and no turn changes that
  const nsvcd__d3 normal = nsvcd__d3_load(gap->contact.normal);
  const nsvcd__d3 point = nsvcd__d3_load(gap->contact.point);
  nsvcd__slope_add(c, both->a, &view, point, normal, 1, gap->slope);
  nsvcd__slope_add(c, both->b, &view, point, normal, -1, gap->slope);
  nsvcd__set_contact(&view, &gap->contact);
  if (gap->verdict != NSVCD_FREE || gap->distance.low > 0) return NSVCD_OK;
  // the poses are free of each other: are the parts?
  question.ask = NSVCD_ASK_HIT;
  question.to = 0;
  question.clearance = nsvcd__above(off);
  result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result || found.verdict == NSVCD_FREE) return result;
  gap->verdict = NSVCD_UNDECIDED;
  gap->why = NSVCD_WHY_TOO_NEAR;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_proximities(nsvcd_checker *checker, const double *joints,
                                        const nsvcd_proximity_options *options,
                                        nsvcd_proximity *gaps, size_t capacity,
                                        size_t *count) {
  nsvcd_proximity_options o;
  size_t near_ones = 0;
  nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (!result && (!count || (!gaps && capacity > 0))) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_length(o.max_distance)) return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__is_length(o.deepest)) return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__is_length(o.to)) return NSVCD_ERROR_TO;
  o.max_distance = o.max_distance > 0 ? o.max_distance : NSVCD__GAP_WITHIN;
  o.to = o.to > 0 ? o.to : NSVCD__GAP_TO;
  o.deepest = o.deepest > 0 ? o.deepest : NSVCD__GAP_DEEPEST;
  nsvcd__set_configuration(checker, joints);
  for (size_t n = 0; n < checker->scene->pair_count && !result; n++) {
    nsvcd_proximity gap;
    int is_near;
    result = nsvcd__gap_of(checker, n, &o, &gap, &is_near);
    if (result || !is_near) continue;
    if (near_ones < capacity) gaps[near_ones] = gap;
    near_ones++;
  }
  if (!result) *count = near_ones;
  return result;
}

// ---- a way out

static void nsvcd__take_into_limits(const nsvcd_scene *scene, double *joints) {
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
    const double low = is_endless ? -(double)NSVCD_MAX_COORDINATE : joint->low;
    const double high = is_endless ? (double)NSVCD_MAX_COORDINATE : joint->high;
    joints[j] = nsvcd__max(low, nsvcd__min(high, joints[j]));
  }
}

static nsvcd_result nsvcd__is_free_at(nsvcd_checker *c, const double *joints,
                                      const nsvcd_nearest_free_options *o, int *is_free) {
  const nsvcd_joint_motion still = {0, 0, joints, NULL};
  const nsvcd_check_options options = {o->clearance, 0, 0, o->stop, o->user};
  nsvcd_check_answer answer;
  const nsvcd_result result = nsvcd_check(c, &still, &options, &answer);
  *is_free = !result && answer.verdict == NSVCD_FREE && answer.joint == NSVCD_NONE;
  return result;
}

// From a place that is free back towards `from`, which is not, as far as that stays free.
static nsvcd_result nsvcd__draw_back(nsvcd_checker *c, const double *from,
                                     const nsvcd_nearest_free_options *o, double *at) {
  const size_t joints = c->scene->joint_count;
  double blocked[NSVCD_MAX_JOINTS];
  nsvcd_result result = NSVCD_OK;
  memcpy(blocked, from, joints * sizeof *at);
  for (size_t n = 0; n < NSVCD__FREE_HALVINGS && !result; n++) {
    double middle[NSVCD_MAX_JOINTS];
    int is_free;
    for (size_t j = 0; j < joints; j++) middle[j] = 0.5 * (blocked[j] + at[j]);
    result = nsvcd__is_free_at(c, middle, o, &is_free);
    if (!result) memcpy(is_free ? at : blocked, middle, joints * sizeof *at);
  }
  return result;
}

// Draws on spheres about `from`, from the inside to the outside, until one is free; then on ever
// smaller ones, nearer than the best.
static nsvcd_result nsvcd__seek_nearest_free(nsvcd_checker *c, const double *from,
                                             const nsvcd_nearest_free_options *o, double *out,
                                             int *is_found) {
  const size_t joints = c->scene->joint_count;
  uint64_t random = o->seed;
  double best = o->farthest;
  *is_found = 0;
  for (size_t n = 0; n < NSVCD__FREE_RINGS * NSVCD__FREE_DRAWS; n++) {
    const double ring = (double)(n / NSVCD__FREE_DRAWS + 1) / NSVCD__FREE_RINGS;
    const double radius = *is_found ? NSVCD__FREE_NEARER * best : ring * o->farthest;
    double at[NSVCD_MAX_JOINTS];
    double square = 0;
    int is_free;
    if (o->stop && o->stop(o->user)) return NSVCD_OK;
    for (size_t j = 0; j < joints; j++) {
      at[j] = 2 * nsvcd__random(&random) - 1;
      square += at[j] * at[j];
    }
    for (size_t j = 0; j < joints; j++) at[j] = from[j] + radius / sqrt(square) * at[j];
    nsvcd__take_into_limits(c->scene, at);
    nsvcd_result result = nsvcd__is_free_at(c, at, o, &is_free);
    if (result) return result;
    if (!is_free) continue;
    result = nsvcd__draw_back(c, from, o, at);
    if (result) return result;
    *is_found = 1;
    best = sqrt(nsvcd__distance2(at, from, joints));
    memcpy(out, at, joints * sizeof *at);
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_nearest_free(nsvcd_checker *checker, const double *joints,
                                         const nsvcd_nearest_free_options *options,
                                         double *out, int *is_found) {
  nsvcd_nearest_free_options o;
  double from[NSVCD_MAX_JOINTS], at[NSVCD_MAX_JOINTS];
  nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (!result && (!out || !is_found)) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  const size_t bytes = checker->scene->joint_count * sizeof(double);
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__in_range(&o.clearance, 1, 0.5f * NSVCD_MAX_COORDINATE) || o.clearance < 0)
    return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_number(o.farthest, (double)NSVCD_MAX_COORDINATE) || o.farthest < 0)
    return NSVCD_ERROR_FARTHEST;
  o.farthest = o.farthest > 0 ? o.farthest : NSVCD__FARTHEST_FREE;
  memcpy(from, joints, bytes);
  nsvcd__take_into_limits(checker->scene, from);
  int is_free;
  memcpy(at, from, bytes);
  result = nsvcd__is_free_at(checker, from, &o, &is_free);
  o.clearance += NSVCD__FREE_ROOM;
  if (!result && !is_free) result = nsvcd__seek_nearest_free(checker, from, &o, at, &is_free);
  if (result) return result;
  *is_found = is_free;
  if (is_free) memcpy(out, at, bytes);
  return NSVCD_OK;
}

// ---- pairs

// Do two parts touch in all of so many configurations, drawn within the limits?
static nsvcd_result nsvcd__contact_in_all(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                          size_t samples, uint64_t random, int *in_all) {
  nsvcd_answer found;
  nsvcd__sight view;
  nsvcd_result result = NSVCD_OK;
  *in_all = 1;
  for (size_t n = 0; n < samples && *in_all && !result; n++) {
    double joints[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < c->scene->joint_count; j++) {
      const nsvcd_joint *joint = &c->scene->joints[j];
      const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
      const double low = is_endless ? 0 : joint->low;
      const double high = is_endless ? 6.283185307179586 : joint->high;
      joints[j] = low + (high - low) * nsvcd__random(&random);
    }
    nsvcd__set_configuration(c, joints);
    const nsvcd_question question = nsvcd__ask_configuration(c, pair, 0, &view);
    result = nsvcd_sweep(&question, c->query, c->query_size, &found);
    *in_all = !result && found.verdict == NSVCD_HIT;
  }
  return result;
}

// Does one joint separate two links, neither of them the world?
static int nsvcd__are_adjacent(const nsvcd_scene *scene, const nsvcd_body_pair *pair) {
  const size_t a = scene->parts[pair->a].link;
  const size_t b = scene->parts[pair->b].link;
  return a > 0 && b > 0 &&
         (scene->joints[a - 1].parent == b || scene->joints[b - 1].parent == a);
}

// The next pair of parts on links that differ; the first after {0, 0}. Returns 0 where there is
// none.
static int nsvcd__next_pair(const nsvcd_scene *scene, nsvcd_body_pair *pair) {
  do {
    if (++pair->b >= scene->part_count) {
      pair->a++;
      pair->b = pair->a + 1;
    }
    if (pair->b >= scene->part_count) return 0;
  } while (scene->parts[pair->a].link == scene->parts[pair->b].link);
  return 1;
}

NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t samples, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts) {
  if (!checker || !counts || (!pairs && capacity > 0)) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  nsvcd_body_pair pair = {0, 0};
  nsvcd_pair_counts found = {0, 0, 0};
  size_t total = 0;
  while (nsvcd__next_pair(scene, &pair)) total++;
  if (capacity < total) return NSVCD_ERROR_WORKSPACE;
  // what is asked from the front, what touches in all samples from the back
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    int in_all;
    if (nsvcd__are_adjacent(scene, &pair)) continue;
    const nsvcd_result result = nsvcd__contact_in_all(
        checker, &pair, samples ? samples : NSVCD__PAIR_SAMPLES, seed, &in_all);
    if (result) return result;
    pairs[in_all ? total - ++found.touching : found.asked++] = pair;
  }
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    if (nsvcd__are_adjacent(scene, &pair)) pairs[found.asked + found.adjacent++] = pair;
  }
  for (size_t n = 0; n < found.touching / 2; n++) {
    nsvcd_body_pair *first = &pairs[total - found.touching + n];
    nsvcd_body_pair *last = &pairs[total - 1 - n];
    pair = *first;
    *first = *last;
    *last = pair;
  }
  *counts = found;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_reparent(const nsvcd_checker *checker, const double *joints,
                                     size_t part, uint32_t link, nsvcd_part *out) {
  nsvcd__configuration c;
  const nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (result) return result;
  const nsvcd_scene *scene = checker->scene;
  if (!out) return NSVCD_ERROR_ARGUMENT;
  if (part >= scene->part_count || link > scene->joint_count) return NSVCD_ERROR_LINK;
  memcpy(c.joints, joints, scene->joint_count * sizeof *joints);
  nsvcd__pose_links(checker, &c);
  const nsvcd__frame at = nsvcd__frame_of_part(checker, &c, part);
  const nsvcd__frame inner = nsvcd__frame_from(&c.frames[link], &at);
  nsvcd_part moved = scene->parts[part];
  moved.link = link;
  moved.pose = nsvcd__pose_in(&inner);
  const nsvcd_result placed = nsvcd__poses_check(&moved.pose, 1);
  if (!placed) *out = moved;
  return placed;
}
