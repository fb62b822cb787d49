// In: a robot in one configuration. Out: pairs that are near, and how that changes with the joints;
// a configuration near by that is free; which pairs can meet.
#pragma once
#include "../ground/random.h"
#include "../interface/postures.h"
#include "path.h"

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
#define NSVCD__GAP_WITHIN 0.05f
#define NSVCD__GAP_TO 1e-4f
#define NSVCD__GAP_DEEPEST 0.02f
#define NSVCD__FARTHEST_ESCAPE 0.5
// metres that an escape leaves beside the clearance, so that a route can begin there
#define NSVCD__ESCAPE_ROOM 5e-4f
// spheres about the joints that random configurations are drawn on, and how many on each; how much
// nearer than the best the next is drawn; halvings of the way back
#define NSVCD__ESCAPE_RINGS 8
#define NSVCD__ESCAPE_DRAWS 64
#define NSVCD__ESCAPE_NEARER 0.9
#define NSVCD__ESCAPE_HALVINGS 10
#define NSVCD__PAIR_SAMPLES 64

static nsvcd_result nsvcd__check_joints(const nsvcd_checker *checker, const double *joints) {
  if (!checker || !joints) return NSVCD_ERROR_ARGUMENT;
  for (size_t j = 0; j < checker->scene->joint_count; j++) {
    if (!nsvcd__is_number(joints[j], (double)NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_NUMBER;
  }
  return NSVCD_OK;
}

// Places all parts where the joints say, as the first of their samples.
static void nsvcd__stand(nsvcd_checker *c, const double *joints) {
  memcpy(c->at.joints, joints, c->scene->joint_count * sizeof *joints);
  nsvcd__place_links(c, &c->at);
  nsvcd__sample_put(c, &c->at, 0);
}

// Of two parts where they stand.
static nsvcd_question nsvcd__standing_question(const nsvcd_checker *c,
                                               const nsvcd_body_pair *pair, size_t work) {
  const nsvcd_pose *const poses[2] = {c->poses + c->members[pair->a].row,
                                      c->poses + c->members[pair->b].row};
  return nsvcd__question_of(c, pair, poses, 1, work);
}

// ---- gaps

// How the point of a part that is at `point` now moves along a normal, by each joint: added to the
// slope, times `sign`.
static void nsvcd__slope_add(const nsvcd_checker *c, size_t part, nsvcd__d3 point,
                             nsvcd__d3 normal, double sign, double *slope) {
  const uint32_t link = c->scene->parts[part].link;
  for (uint32_t path = link ? c->links[link - 1].path : 0; path; path &= path - 1) {
    const size_t j = nsvcd__low_bit(path);
    const nsvcd__d3 lever = nsvcd__d3_sub(point, c->at.frames[j + 1].place);
    const nsvcd__d3 speed =
        nsvcd__slides(c, j) ? c->at.axes[j] : nsvcd__d3_cross(c->at.axes[j], lever);
    slope[j] += sign * nsvcd__d3_dot(normal, speed);
  }
}

// The gap of a pair where it stands. Returns its `low` as HUGE_VALF where it is not within.
static nsvcd_result nsvcd__gap_of(nsvcd_checker *c, size_t pair, const nsvcd_gap_options *o,
                                  nsvcd_gap *gap) {
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  nsvcd_answer found;
  memset(gap, 0, sizeof *gap);
  gap->pair = pair;
  gap->distance.low = HUGE_VALF;
  if (nsvcd__boxes_apart(&c->members[both->a].box, &c->members[both->b].box,
                         1.000001 * (double)o->within))
    return NSVCD_OK;
  nsvcd_question question = nsvcd__standing_question(c, both, o->work);
  question.clearance = o->within;
  nsvcd_result result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result || found.verdict == NSVCD_FREE) return result;
  question.clearance = 0;
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = o->to;
  result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result) return result;
  gap->distance = found.distance;
  gap->contact = found.nearest;
  if (found.verdict == NSVCD_HIT) {
    gap->distance.low = gap->distance.high = 0;
    gap->depth = HUGE_VALF;
    question.ask = NSVCD_ASK_HIT;
    question.to = 0;
    question.skin = o->deepest;
    if (!found.inside) result = nsvcd_sweep(&question, c->query, c->query_size, &found);
    const nsvcd__d3 lift = nsvcd__d3_load(found.lift);
    const double length = nsvcd__d3_length(lift);
    if (!found.inside && length > 0) {
      gap->depth = found.depth;
      nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(lift, 1 / length)), gap->contact.normal);
    }
  }
  // of both at the point on b: that on a is off it along the normal, and no turn changes that
  const nsvcd__d3 normal = nsvcd__d3_load(gap->contact.normal);
  const nsvcd__d3 point = nsvcd__d3_load(gap->contact.point);
  nsvcd__slope_add(c, both->a, point, normal, 1, gap->slope);
  nsvcd__slope_add(c, both->b, point, normal, -1, gap->slope);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_gaps(nsvcd_checker *checker, const double *joints,
                                 const nsvcd_gap_options *options, nsvcd_gap *gaps,
                                 size_t capacity, size_t *count) {
  nsvcd_gap_options o;
  size_t near_ones = 0;
  nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (!result && (!count || (!gaps && capacity > 0))) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  const float *lengths[3] = {&o.within, &o.to, &o.deepest};
  for (size_t n = 0; n < 3; n++) {
    if (!nsvcd__is_finite(*lengths[n]) || *lengths[n] < 0) return NSVCD_ERROR_TOLERANCE;
  }
  o.within = o.within > 0 ? o.within : NSVCD__GAP_WITHIN;
  o.to = o.to > 0 ? o.to : NSVCD__GAP_TO;
  o.deepest = o.deepest > 0 ? o.deepest : NSVCD__GAP_DEEPEST;
  nsvcd__stand(checker, joints);
  for (size_t n = 0; n < checker->scene->pair_count && !result; n++) {
    nsvcd_gap gap;
    result = nsvcd__gap_of(checker, n, &o, &gap);
    if (result || !(gap.distance.low < HUGE_VALF)) continue;
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
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    joints[j] = nsvcd__max(joint->low, nsvcd__min(joint->high, joints[j]));
  }
}

static nsvcd_result nsvcd__is_free_at(nsvcd_checker *c, const double *joints, float clearance,
                                      int *is_free) {
  const nsvcd_joint_motion still = {0, 0, joints, NULL};
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&options, 0, sizeof options);
  options.clearance = clearance;
  const nsvcd_result result = nsvcd_check(c, &still, &options, &answer);
  *is_free = !result && answer.verdict == NSVCD_FREE && answer.joint == NSVCD_NONE;
  return result;
}

// From a place that is free back towards `from`, which is not, as far as that stays free.
static nsvcd_result nsvcd__draw_back(nsvcd_checker *c, const double *from, float clearance,
                                     double *at) {
  const size_t joints = c->scene->joint_count;
  double blocked[NSVCD_MAX_JOINTS];
  nsvcd_result result = NSVCD_OK;
  memcpy(blocked, from, joints * sizeof *at);
  for (size_t n = 0; n < NSVCD__ESCAPE_HALVINGS && !result; n++) {
    double middle[NSVCD_MAX_JOINTS];
    int is_free;
    for (size_t j = 0; j < joints; j++) middle[j] = 0.5 * (blocked[j] + at[j]);
    result = nsvcd__is_free_at(c, middle, clearance, &is_free);
    if (!result) memcpy(is_free ? at : blocked, middle, joints * sizeof *at);
  }
  return result;
}

// Draws on spheres about `from`, from the inside to the outside, until one is free; then on ever
// smaller ones, nearer than the best.
static nsvcd_result nsvcd__seek_escape(nsvcd_checker *c, const double *from, float clearance,
                                       double farthest, uint64_t random, double *out,
                                       int *is_found) {
  const size_t joints = c->scene->joint_count;
  double best = farthest;
  *is_found = 0;
  for (size_t n = 0; n < NSVCD__ESCAPE_RINGS * NSVCD__ESCAPE_DRAWS; n++) {
    const double ring = (double)(n / NSVCD__ESCAPE_DRAWS + 1) / NSVCD__ESCAPE_RINGS;
    const double radius = *is_found ? NSVCD__ESCAPE_NEARER * best : ring * farthest;
    double at[NSVCD_MAX_JOINTS];
    double square = 0;
    int is_free;
    for (size_t j = 0; j < joints; j++) {
      at[j] = 2 * nsvcd__random(&random) - 1;
      square += at[j] * at[j];
    }
    for (size_t j = 0; j < joints; j++) at[j] = from[j] + radius / sqrt(square) * at[j];
    nsvcd__take_into_limits(c->scene, at);
    nsvcd_result result = nsvcd__is_free_at(c, at, clearance, &is_free);
    if (result) return result;
    if (!is_free) continue;
    result = nsvcd__draw_back(c, from, clearance, at);
    if (result) return result;
    *is_found = 1;
    square = 0;
    for (size_t j = 0; j < joints; j++) square += (at[j] - from[j]) * (at[j] - from[j]);
    best = sqrt(square);
    memcpy(out, at, joints * sizeof *at);
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_escape(nsvcd_checker *checker, const double *joints,
                                   const nsvcd_escape_options *options, double *out,
                                   int *is_found) {
  nsvcd_escape_options o;
  double from[NSVCD_MAX_JOINTS], at[NSVCD_MAX_JOINTS];
  nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (!result && (!out || !is_found)) result = NSVCD_ERROR_ARGUMENT;
  if (result) return result;
  const size_t bytes = checker->scene->joint_count * sizeof(double);
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_finite(o.clearance) || o.clearance < 0) return NSVCD_ERROR_TOLERANCE;
  if (!nsvcd__is_number(o.farthest, (double)NSVCD_MAX_COORDINATE) || o.farthest < 0)
    return NSVCD_ERROR_NUMBER;
  const double farthest = o.farthest > 0 ? o.farthest : NSVCD__FARTHEST_ESCAPE;
  memcpy(from, joints, bytes);
  nsvcd__take_into_limits(checker->scene, from);
  int is_free;
  memcpy(at, from, bytes);
  result = nsvcd__is_free_at(checker, from, o.clearance, &is_free);
  if (!result && !is_free)
    result = nsvcd__seek_escape(checker, from, o.clearance + NSVCD__ESCAPE_ROOM, farthest,
                                o.seed, at, &is_free);
  if (result) return result;
  *is_found = is_free;
  if (is_free) memcpy(out, at, bytes);
  return NSVCD_OK;
}

// ---- pairs

typedef enum nsvcd__pair_kind {
  NSVCD__PAIR_ASKED = 0,
  NSVCD__PAIR_ADJACENT,
  NSVCD__PAIR_TOUCHING
} nsvcd__pair_kind;

// Do two parts touch in so many configurations, drawn within the limits?
static nsvcd_result nsvcd__touch_always(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                        size_t samples, uint64_t random, int *always) {
  nsvcd_answer found;
  nsvcd_result result = NSVCD_OK;
  *always = 1;
  for (size_t n = 0; n < samples && *always && !result; n++) {
    double joints[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < c->scene->joint_count; j++) {
      const nsvcd_joint *joint = &c->scene->joints[j];
      const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
      const double low = is_endless ? 0 : joint->low;
      const double high = is_endless ? 6.283185307179586 : joint->high;
      joints[j] = low + (high - low) * nsvcd__random(&random);
    }
    nsvcd__stand(c, joints);
    const nsvcd_question question = nsvcd__standing_question(c, pair, 0);
    result = nsvcd_sweep(&question, c->query, c->query_size, &found);
    *always = !result && found.verdict == NSVCD_HIT;
  }
  return result;
}

static nsvcd_result nsvcd__pair_kind_of(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                        size_t samples, uint64_t random, int *kind) {
  const size_t a = c->scene->parts[pair->a].link;
  const size_t b = c->scene->parts[pair->b].link;
  const nsvcd_joint *joints = c->scene->joints;
  *kind = NSVCD__PAIR_ADJACENT;
  if (a > 0 && b > 0 && (joints[a - 1].parent == b || joints[b - 1].parent == a))
    return NSVCD_OK;
  int always;
  const nsvcd_result result = nsvcd__touch_always(c, pair, samples, random, &always);
  *kind = always ? NSVCD__PAIR_TOUCHING : NSVCD__PAIR_ASKED;
  return result;
}

NSVCDDEF nsvcd_result nsvcd_find_pairs(nsvcd_checker *checker, size_t samples, uint64_t seed,
                                       nsvcd_body_pair *pairs, size_t capacity,
                                       nsvcd_pair_counts *counts) {
  if (!checker || !counts || (!pairs && capacity > 0)) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  size_t found[3] = {0, 0, 0};
  size_t total = 0;
  for (size_t a = 0; a < scene->part_count; a++) {
    for (size_t b = a + 1; b < scene->part_count; b++)
      total += scene->parts[a].link != scene->parts[b].link;
  }
  if (capacity < total) return NSVCD_ERROR_WORKSPACE;
  total = 0;
  for (int kind = NSVCD__PAIR_ASKED; kind <= NSVCD__PAIR_TOUCHING; kind++) {
    for (size_t a = 0; a < scene->part_count; a++) {
      for (size_t b = a + 1; b < scene->part_count; b++) {
        const nsvcd_body_pair pair = {(uint32_t)a, (uint32_t)b};
        int is_of;
        if (scene->parts[a].link == scene->parts[b].link) continue;
        const nsvcd_result result = nsvcd__pair_kind_of(
            checker, &pair, samples ? samples : NSVCD__PAIR_SAMPLES, seed, &is_of);
        if (result) return result;
        if (is_of != kind) continue;
        pairs[total++] = pair;
        found[kind]++;
      }
    }
  }
  counts->asked = found[NSVCD__PAIR_ASKED];
  counts->adjacent = found[NSVCD__PAIR_ADJACENT];
  counts->touching = found[NSVCD__PAIR_TOUCHING];
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_hand_over(const nsvcd_checker *checker, const double *joints,
                                      size_t part, uint32_t link, nsvcd_part *out) {
  nsvcd__configuration c;
  const nsvcd_result result = nsvcd__check_joints(checker, joints);
  if (result) return result;
  const nsvcd_scene *scene = checker->scene;
  if (!out || part >= scene->part_count || link > scene->joint_count)
    return NSVCD_ERROR_ARGUMENT;
  memcpy(c.joints, joints, scene->joint_count * sizeof *joints);
  nsvcd__place_links(checker, &c);
  const nsvcd__frame at = nsvcd__frame_of_part(checker, &c, part);
  const nsvcd__frame *to = &c.frames[link];
  const nsvcd__dquat back = {-to->turn.x, -to->turn.y, -to->turn.z, to->turn.w};
  const nsvcd__frame inner = {nsvcd__dquat_inverse_mul(to->turn, at.turn),
                              nsvcd__dquat_rotate(back, nsvcd__d3_sub(at.place, to->place))};
  nsvcd_part moved = scene->parts[part];
  moved.link = link;
  moved.pose = nsvcd__pose_in(&inner);
  *out = moved;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS
