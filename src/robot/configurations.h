// In: a robot in one configuration. Out: pairs that are near each other, and how their distances
// change with the joints; the nearest configuration that is free; which pairs can meet.
#pragma once
#include "../interface/configurations.h"
#include "check.h"
#include "rrt.h"

// defaults
#define NSVCD__MAX_DISTANCE 0.05f
#define NSVCD__DISTANCE_TO 2e-5f
#define NSVCD__MAX_DEPTH 0.02f
#define NSVCD__FARTHEST_FREE 0.5
#define NSVCD__PAIR_DRAWS 64
// of `max_depth`: the first slop that is tried; and how often a push-out is halved
#define NSVCD__LEAST_SLOP 0.015625f
#define NSVCD__DEPTH_HALVINGS 12
// of the depth: how far parts are pushed out to see which faces separate last
#define NSVCD__DEPTH_BEYOND 1.01
// the least cosine between a push-out and the normal for which there is a slope
#define NSVCD__LEAST_RATE 0.1
// metres that the nearest free configuration has beside the clearance, so that a route can begin
// there
#define NSVCD__FREE_ROOM 5e-4f
// and the share of a cone's angle that it keeps to
#define NSVCD__FREE_CONE 0.95
// spheres about the joints on which configurations are drawn, and how many on each
#define NSVCD__FREE_SPHERES 8
#define NSVCD__FREE_DRAWS 64
// how much nearer than the best the next one is drawn; halvings of the line back
#define NSVCD__FREE_NEARER 0.9
#define NSVCD__FREE_HALVINGS 10

static nsvcd_result nsvcd__check_joints(const nsvcd_checker *c, const double *joints) {
  if (!c || !joints) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__are_numbers(joints, c->scene->joint_count)) return NSVCD_ERROR_VALUE;
  return nsvcd__follows(c->scene, 1, joints) ? NSVCD_OK : NSVCD_ERROR_MIMIC;
}

// ---- proximities

// Adds to the slope how fast a point of a part moves along a direction by each joint and those that
// it drives, times `sign`. The point and the direction are in the local frame.
static void nsvcd__slope_add(const nsvcd_checker *c, size_t part, const nsvcd__local *local,
                             nsvcd__d3 at, nsvcd__d3 along, double sign, double *slope) {
  const nsvcd__d3 point = nsvcd__dpose_apply(&local->frame, at);
  const nsvcd__d3 normal = nsvcd__dquat_rotate(local->frame.rotation, along);
  for (size_t link = c->scene->parts[part].link; link > 0;
       link = nsvcd__link_before(c, link)) {
    const nsvcd__d3 arm = nsvcd__d3_sub(point, c->at->frames[link].position);
    const nsvcd__d3 axis = c->at->axes[link - 1];
    const nsvcd__d3 speed = nsvcd__slides(c, link - 1) ? axis : nsvcd__d3_cross(axis, arm);
    slope[nsvcd__driver(c->scene, link - 1)] +=
        sign * nsvcd__rate(c->scene, link - 1) * nsvcd__d3_dot(normal, speed);
  }
}

// Asks a question with a pushed out.
static nsvcd_verdict nsvcd__ask_pushed(nsvcd_checker *c, const nsvcd_question *q,
                                       nsvcd__d3 push_out, nsvcd_answer *found) {
  nsvcd_pose pose = *q->a.poses;
  nsvcd_question pushed = *q;
  const nsvcd__d3 position = nsvcd__d3_add(nsvcd__d3_load(pose.position), push_out);
  pushed.a.poses = &pose;
  nsvcd__f3_store(nsvcd__f3_round(position), pose.position);
  return nsvcd__ask_sweep(c, &pushed, found);
}

// A push-out of a off b that separates them. Slops are tried, each four times the one before, up to
// `max_depth`; 0 where none is enough.
static nsvcd__d3 nsvcd__separating_push_out(nsvcd_checker *c, nsvcd_question q,
                                            float max_depth) {
  nsvcd_answer found;
  for (float fraction = NSVCD__LEAST_SLOP; fraction <= 1; fraction *= 4) {
    q.slop = fraction * max_depth;
    if (nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE) return nsvcd__d3_load(found.push_out);
  }
  return nsvcd__d3_of(0, 0, 0);
}

// Of parts that touch: the depth, its contact and its slope. q: asks HIT, with all errors of the
// poses as its clearance.
static void nsvcd__depth_of(nsvcd_checker *c, nsvcd_question q, const nsvcd__local *local,
                            const nsvcd_proximity_options *o, nsvcd_proximity *out) {
  const nsvcd_body_pair *pair = &c->scene->pairs[out->pair];
  const nsvcd__d3 push_out = nsvcd__separating_push_out(c, q, o->max_depth);
  const double length = nsvcd__d3_norm(push_out);
  nsvcd_answer found;
  // fractions of the push-out: they touch at the first, and are apart at the second
  double low = 0;
  double high = 1;
  if (!(length > 0)) return;
  for (size_t n = 0; n < NSVCD__DEPTH_HALVINGS; n++) {
    const double middle = 0.5 * (low + high);
    const nsvcd__d3 part = nsvcd__d3_scale(push_out, middle);
    const int is_apart = nsvcd__ask_pushed(c, &q, part, &found) == NSVCD_FREE;
    *(is_apart ? &high : &low) = middle;
  }
  // a little beyond: which faces are near?
  const double beyond = NSVCD__DEPTH_BEYOND * high + (double)o->to / length;
  q.clearance = 0;
  q.ask = NSVCD_ASK_DISTANCE;
  q.to = 0.1f * o->to;
  (void)nsvcd__ask_pushed(c, &q, nsvcd__d3_scale(push_out, beyond), &found);
  const nsvcd__d3 along = nsvcd__d3_scale(push_out, 1 / length);
  const nsvcd__d3 normal = nsvcd__d3_load(found.nearest.normal);
  const nsvcd__d3 point = nsvcd__d3_load(found.nearest.point);
  out->depth = nsvcd__above(high * length);
  out->contact = found.nearest;
  out->contact.gap = 0;
  nsvcd__f3_store(nsvcd__f3_round(along), out->contact.normal);
  nsvcd__contact_to_world(local, &out->contact);
  // a push-out separates the two faces at this fraction of its own speed
  const double rate = nsvcd__d3_dot(along, normal);
  if (!(rate > NSVCD__LEAST_RATE)) return;
  const nsvcd__d3 on_a = nsvcd__d3_fma(-high, push_out, point);
  nsvcd__slope_add(c, pair->a, local, on_a, normal, 1 / rate, out->slope);
  nsvcd__slope_add(c, pair->b, local, point, normal, -1 / rate, out->slope);
}

// The proximity of a pair in the configuration c->at. Returns 0 if it is not within max_distance.
static int nsvcd__proximity_of(nsvcd_checker *c, size_t index,
                               const nsvcd_proximity_options *o, nsvcd_proximity *out) {
  const nsvcd_body_pair *pair = &c->scene->pairs[index];
  const nsvcd__member *a = &c->members[pair->a];
  const nsvcd__member *b = &c->members[pair->b];
  nsvcd_answer found;
  const double frames_error = 2 * (a->rounding + b->rounding);
  const double max_distance = (double)o->max_distance + frames_error;
  if (nsvcd__bounds_apart(&a->bounds, &b->bounds, 1.000001 * max_distance)) return 0;
  const nsvcd__local local = nsvcd__localize_at(c, pair);
  nsvcd_question q = nsvcd__question_of(c, pair, 1, o->work);
  const double error = frames_error + local.rounding;
  q.clearance = nsvcd__above((double)o->max_distance + error);
  if (nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE) return 0;
  q.clearance = 0;
  q.ask = NSVCD_ASK_DISTANCE;
  q.to = o->to;
  memset(out, 0, sizeof *out);
  out->pair = index;
  out->verdict = nsvcd__ask_sweep(c, &q, &found);
  out->why = found.why;
  out->contact = found.nearest;
  nsvcd__contact_to_world(&local, &out->contact);
  q.ask = NSVCD_ASK_HIT;
  q.to = 0;
  if (found.verdict == NSVCD_HIT) {
    out->distance.high = nsvcd__above(error);
    out->depth = HUGE_VALF;
    // push-outs are rounded to float
    q.clearance = nsvcd__above(error + 2e-7 * (double)o->max_depth);
    if (!found.inside) nsvcd__depth_of(c, q, &local, o, out);
    return 1;
  }
  out->distance.high = nsvcd__above((double)found.distance.high + error);
  out->distance.low = (float)nsvcd__max((double)found.distance.low * (1 - 1e-7) - error, 0);
  // of both at the point on b: that on a is off it along the normal, and no turn changes that
  const nsvcd__d3 normal = nsvcd__d3_load(found.nearest.normal);
  const nsvcd__d3 point = nsvcd__d3_load(found.nearest.point);
  nsvcd__slope_add(c, pair->a, &local, point, normal, 1, out->slope);
  nsvcd__slope_add(c, pair->b, &local, point, normal, -1, out->slope);
  if (out->verdict != NSVCD_FREE || out->distance.low > 0) return 1;
  // the poses in float are free of each other: are the parts?
  q.clearance = nsvcd__above(error);
  if (nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE) return 1;
  out->verdict = NSVCD_UNDECIDED;
  out->why = NSVCD_WHY_TOO_NEAR;
  return 1;
}

NSVCDDEF nsvcd_result nsvcd_proximities(nsvcd_checker *c, const double *joints,
                                        const nsvcd_proximity_options *options,
                                        nsvcd_proximity *out, size_t capacity, size_t *count) {
  nsvcd_proximity_options o;
  size_t written = 0;
  nsvcd_result result = nsvcd__check_joints(c, joints);
  if (!result && (!count || (!out && capacity > 0))) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_length(o.max_distance) || !nsvcd__is_length(o.max_depth))
    return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__is_length(o.to)) return NSVCD_ERROR_TO;
  o.max_distance = o.max_distance > 0 ? o.max_distance : NSVCD__MAX_DISTANCE;
  o.to = o.to > 0 ? o.to : NSVCD__DISTANCE_TO;
  o.max_depth = o.max_depth > 0 ? o.max_depth : NSVCD__MAX_DEPTH;
  nsvcd__place_links(c, joints, c->at);
  nsvcd__place_sample(c, c->at, 0);
  c->result = NSVCD_OK;
  for (size_t n = 0; n < c->scene->pair_count && !c->result; n++) {
    nsvcd_proximity found;
    if (!nsvcd__proximity_of(c, n, &o, &found)) continue;
    if (written < capacity) out[written] = found;
    written++;
  }
  if (!c->result) *count = written;
  return c->result;
}

// ---- the nearest free configuration

// Is a configuration free? An error is in c->result.
static int nsvcd__is_free_at(nsvcd_checker *c, const double *joints,
                             const nsvcd_nearest_free_options *o) {
  const nsvcd_joint_motion still = {0, 0, joints, NULL};
  const nsvcd_check_options options = {o->clearance, 0, 0, o->stop, o->user, 0};
  nsvcd_check_answer answer;
  return !nsvcd_check(c, &still, &options, &answer) && nsvcd__proves_free(&answer);
}

// Moves a free configuration towards `from`, which is not free, as far as that stays free.
static void nsvcd__draw_back(nsvcd_checker *c, const double *from,
                             const nsvcd_nearest_free_options *o, double *at) {
  const size_t joints = c->scene->joint_count;
  double blocked[NSVCD_MAX_JOINTS], middle[NSVCD_MAX_JOINTS];
  memcpy(blocked, from, joints * sizeof *at);
  for (size_t n = 0; n < NSVCD__FREE_HALVINGS && !c->result; n++) {
    for (size_t j = 0; j < joints; j++) middle[j] = 0.5 * (blocked[j] + at[j]);
    nsvcd__follow(c->scene, 1, middle);
    const int is_free = nsvcd__is_free_at(c, middle, o);
    memcpy(is_free ? at : blocked, middle, joints * sizeof *at);
  }
}

// Draws on spheres about `from`, the innermost first, until a configuration is free; then on ever
// smaller ones, nearer than the best. Returns 0 if none is found.
static int nsvcd__seek_nearest_free(nsvcd_checker *c, const double *from,
                                    const nsvcd_nearest_free_options *o, double *out) {
  const size_t joints = c->scene->joint_count;
  uint64_t random = o->seed;
  double best = o->farthest;
  int is_found = 0;
  for (size_t n = 0; n < NSVCD__FREE_SPHERES * NSVCD__FREE_DRAWS && !c->result; n++) {
    const double sphere = (double)(n / NSVCD__FREE_DRAWS + 1) / NSVCD__FREE_SPHERES;
    const double radius = is_found ? NSVCD__FREE_NEARER * best : sphere * o->farthest;
    double at[NSVCD_MAX_JOINTS];
    double square = 0;
    if (o->stop && o->stop(o->user)) break;
    for (size_t j = 0; j < joints; j++) at[j] = 2 * nsvcd__random(&random) - 1;
    for (size_t j = 0; j < joints; j++) {
      at[j] = nsvcd__rate(c->scene, j) * at[nsvcd__driver(c->scene, j)];
      square += at[j] * at[j];
    }
    for (size_t j = 0; j < joints; j++) at[j] = from[j] + radius / sqrt(square) * at[j];
    nsvcd__clamp_to_limits(c->scene, at);
    if (!nsvcd__into_cones(c, NULL, NSVCD__FREE_CONE, at)) continue;
    // which may have led away
    if (nsvcd__distance2(at, from, joints) > best * best * (1 + 1e-9)) continue;
    if (!nsvcd__is_free_at(c, at, o)) continue;
    nsvcd__draw_back(c, from, o, at);
    is_found = 1;
    best = sqrt(nsvcd__distance2(at, from, joints));
    memcpy(out, at, joints * sizeof *at);
  }
  return is_found;
}

NSVCDDEF nsvcd_result nsvcd_nearest_free(nsvcd_checker *c, const double *joints,
                                         const nsvcd_nearest_free_options *options,
                                         double *out, int *is_found) {
  nsvcd_nearest_free_options o;
  double from[NSVCD_MAX_JOINTS], at[NSVCD_MAX_JOINTS];
  nsvcd_result result = nsvcd__check_joints(c, joints);
  if (!result && (!out || !is_found)) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  const size_t bytes = c->scene->joint_count * sizeof(double);
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__in_range(&o.clearance, 1, 0.5f * NSVCD_MAX_COORDINATE) || o.clearance < 0)
    return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__are_numbers(&o.farthest, 1) || o.farthest < 0) return NSVCD_ERROR_FARTHEST;
  o.farthest = o.farthest > 0 ? o.farthest : NSVCD__FARTHEST_FREE;
  memcpy(from, joints, bytes);
  nsvcd__clamp_to_limits(c->scene, from);
  memcpy(at, from, bytes);
  int is_free = nsvcd__is_free_at(c, from, &o);
  o.clearance += NSVCD__FREE_ROOM;
  if (!is_free && !c->result) is_free = nsvcd__seek_nearest_free(c, from, &o, at);
  if (c->result) return c->result;
  *is_found = is_free;
  if (is_free) memcpy(out, at, bytes);
  return NSVCD_OK;
}

// ---- pairs

// Do two parts touch in all of so many configurations, drawn within the limits?
static int nsvcd__touches_in_all(nsvcd_checker *c, const nsvcd_body_pair *pair, size_t draws,
                                 uint64_t random) {
  nsvcd_answer found;
  for (size_t n = 0; n < draws; n++) {
    double joints[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < c->scene->joint_count; j++) {
      const nsvcd_joint *joint = &c->scene->joints[j];
      const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
      const double low = is_endless ? 0 : joint->low;
      const double high = is_endless ? 6.283185307179586 : joint->high;
      joints[j] = low + (high - low) * nsvcd__random(&random);
    }
    nsvcd__follow(c->scene, 1, joints);
    nsvcd__place_links(c, joints, c->at);
    (void)nsvcd__localize_at(c, pair);
    const nsvcd_question q = nsvcd__question_of(c, pair, 1, 0);
    if (nsvcd__ask_sweep(c, &q, &found) != NSVCD_HIT) return 0;
  }
  return 1;
}

// Are two links those of one joint, and neither of them the world?
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

NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *c, size_t draws, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts) {
  if (!c || !counts || (!pairs && capacity > 0)) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = c->scene;
  nsvcd_body_pair pair = {0, 0};
  nsvcd_pair_counts found = {0, 0, 0};
  size_t total = 0;
  while (nsvcd__next_pair(scene, &pair)) total++;
  if (capacity < total) return NSVCD_ERROR_WORKSPACE;
  if (!draws) draws = NSVCD__PAIR_DRAWS;
  c->result = NSVCD_OK;
  // what is to be asked from the front, what touches in all from the back
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    if (nsvcd__are_adjacent(scene, &pair)) continue;
    const int in_all = nsvcd__touches_in_all(c, &pair, draws, seed);
    if (c->result) return c->result;
    pairs[in_all ? total - ++found.touching : found.asked++] = pair;
  }
  pair.a = pair.b = 0;
  while (nsvcd__next_pair(scene, &pair)) {
    if (nsvcd__are_adjacent(scene, &pair)) pairs[found.asked + found.adjacent++] = pair;
  }
  // what touches, in order
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

NSVCDDEF nsvcd_result nsvcd_reparent(const nsvcd_checker *c, const double *joints, size_t part,
                                     uint32_t link, nsvcd_part *out) {
  nsvcd__links at;
  nsvcd_result result = nsvcd__check_joints(c, joints);
  if (result) return result;
  const nsvcd_scene *scene = c->scene;
  if (!out) return NSVCD_ERROR_ARGUMENT;
  if (part >= scene->part_count || link > scene->joint_count) return NSVCD_ERROR_LINK;
  nsvcd__place_links(c, joints, &at);
  const nsvcd__dpose world = nsvcd__frame_of_part(c, &at, part);
  const nsvcd__dpose frame = nsvcd__dpose_inverse_mul(&at.frames[link], &world);
  nsvcd_part moved = scene->parts[part];
  moved.link = link;
  moved.pose = nsvcd__dpose_round(&frame);
  result = nsvcd__poses_check(&moved.pose, 1);
  if (!result) *out = moved;
  return result;
}
