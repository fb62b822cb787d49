// In: the poses at the moments, and of each body its bounding sphere and the box of its patches.
// Out: the cost of collision and its derivative by the poses.
//
// A plan asks about each pair in each segment, and most of these are far from a collision. A broad
// phase of whole bodies rules those out for less than a query costs: p->meets (moments) is 0 where
// a query about the segment that begins there would prove it free. (The broad phase of
// search/search then goes through the patches of two bodies in one segment.)
//
// It is conservative. A sphere's centre is covered by the box about its two ends, which grows by as
// much as the centre may deviate from their chord. The motion is the query's: as b sees it, a's
// origin goes straight, and a turns evenly about one axis by an angle c, which is at most what a
// and b turn in the world. Either of two tests rules a pair out:
//
//   a's sphere against b's box. Its centre turns about a's origin on an arc of radius `arm` or
//   less, and deviates by at most the arc's height, arm (1 - cos(c / 2)).
//
//   b's sphere against a's box. As a sees it, its centre v moves and turns at once. It deviates by
//   at most an eighth of its acceleration, c^2 |v| + 2 c |u|, where u is its displacement in b's
//   axes: at most that in a's axes + c |v|. In all: c (c |v| 3 / 8 + displacement in a's axes / 4).
#pragma once
#include "../body/trust.h"
#include "problem.h"

#ifndef NSVCD_NO_OPTIMIZER
// The shapes of all bodies.
static void nsvcd__find_shapes(nsvcd__planner *p) {
  for (size_t b = 0; p->in->bodies && b < p->in->body_count; b++) {
    const nsvcd_body *body = p->in->bodies[b];
    nsvcd__shape shape = {{{0, 0, 0}, 0},
                          {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    float position[3];
    float r;
    if (!body) continue;
    const nsvcd_body_facts facts = nsvcd_body_describe(body);
    shape.sphere.centre = nsvcd__f3_load(facts.centre);
    shape.sphere.radius = facts.radius;
    for (uint32_t i = 0; nsvcd_body_patch(body, i, position, &r); i++) {
      const nsvcd__f3 about = nsvcd__f3_of(r, r, r);
      const nsvcd__f3 centre = nsvcd__f3_load(position);
      shape.box.low = nsvcd__f3_min(shape.box.low, nsvcd__f3_sub(centre, about));
      shape.box.high = nsvcd__f3_max(shape.box.high, nsvcd__f3_add(centre, about));
    }
    p->shapes[b] = shape;
  }
}

// The stances of all bodies, from p->poses.
static void nsvcd__find_stances(nsvcd__planner *p, size_t moments) {
  const size_t bodies = p->in->body_count;
  for (size_t b = 0; p->in->bodies && b < bodies; b++) {
    if (!p->in->bodies[b]) continue;
    for (size_t s = 0; s < moments; s++) {
      const nsvcd_pose *pose = &p->poses[s * bodies + b];
      const nsvcd_pose *next = s + 1 < moments ? pose + bodies : pose;
      const nsvcd__quat q = nsvcd__quat_load(pose->rotation);
      const float cosine = nsvcd__quat_dot(q, nsvcd__quat_load(next->rotation));
      const float square = 1.000001f - fabsf(cosine);
      nsvcd__stance *stance = &p->stances[s * bodies + b];
      stance->pose.rotation = nsvcd__mat3_of(q);
      stance->pose.position = nsvcd__f3_load(pose->position);
      stance->centre = nsvcd__mat3_apply(&stance->pose.rotation, p->shapes[b].sphere.centre);
      stance->bend = sqrtf(square > 0 ? square : 0);
    }
  }
}

// Does the bounding sphere of `body` stay farther than the clearance from the box of `other`, from
// moment s to s + stride? rests: in the query `body` rests, and `other` moves.
static inline int nsvcd__passes_by(const nsvcd__planner *p, size_t body, size_t other,
                                   int rests, size_t s, size_t stride) {
  const nsvcd__sphere *sphere = &p->shapes[body].sphere;
  const nsvcd__box *box = &p->shapes[other].box;
  const nsvcd__stance *now = p->stances + s * p->in->body_count;
  // the sphere's centre as `other` sees it at both ends, and the sum of its distances from the
  // origin of `other`
  nsvcd__f3 seen[2];
  float distance = 0;
  for (size_t k = 0; k < 2; k++) {
    const nsvcd__stance *at = now + k * stride * p->in->body_count;
    const nsvcd__transform *from = &at[other].pose;
    const nsvcd__f3 origin = nsvcd__f3_sub(at[body].pose.position, from->position);
    const nsvcd__f3 centre = nsvcd__f3_add(origin, at[body].centre);
    seen[k] = nsvcd__mat3_apply_transpose(&from->rotation, centre);
    distance += nsvcd__f3_norm(centre);
  }

  // The root of 1 - cos of a sum of angles is at most the sum of their roots, and c < 3.15 bend.
  const float bend = now[body].bend + now[other].bend;
  float deviation = nsvcd__f3_norm(sphere->centre) * bend * bend;
  if (rests) {
    const nsvcd__f3 travel = nsvcd__f3_sub(seen[1], seen[0]);
    const float length = fabsf(travel.x) + fabsf(travel.y) + fabsf(travel.z);
    deviation = (3.75f * bend * distance + 0.8f * length) * bend;
  }
  const float radius = 1.00001f * sphere->radius + p->options.sweep.clearance;
  const float grown = radius + (float)stride * deviation + NSVCD__ROUNDING * distance;
  const nsvcd__f3 about = nsvcd__f3_of(grown, grown, grown);
  const nsvcd__f3 low = nsvcd__f3_min(seen[0], seen[1]);
  const nsvcd__f3 high = nsvcd__f3_max(seen[0], seen[1]);
  return nsvcd__f3_exceeds(low, nsvcd__f3_add(box->high, about)) |
         nsvcd__f3_exceeds(nsvcd__f3_sub(box->low, about), high);
}

// Marks in p->meets the segments (stride 1) or moments (stride 0) in which a pair may meet.
static void nsvcd__find_meetings(nsvcd__planner *p, const nsvcd_body_pair *pair,
                                 size_t moments, size_t stride) {
  for (size_t s = 0; s + stride < moments; s++) {
    p->meets[s] = !nsvcd__passes_by(p, pair->a, pair->b, 0, s, stride) &&
                  !nsvcd__passes_by(p, pair->b, pair->a, 1, s, stride);
  }
}

// ---- collision

// The pose of a as b sees it.
static nsvcd_pose nsvcd__relative_pose(const nsvcd_pose *a, const nsvcd_pose *b) {
  const nsvcd__quat q = nsvcd__quat_load(b->rotation);
  const nsvcd__mat3 axes = nsvcd__mat3_of(q);
  const nsvcd__f3 from = nsvcd__f3_load(b->position);
  const nsvcd__f3 offset = nsvcd__f3_sub(nsvcd__f3_load(a->position), from);
  const nsvcd__quat back = nsvcd__quat_inverse(q);
  nsvcd_pose out;
  nsvcd__f3_store(nsvcd__mat3_apply_transpose(&axes, offset), out.position);
  nsvcd__quat_store(nsvcd__quat_mul(back, nsvcd__quat_load(a->rotation)), out.rotation);
  return out;
}

// The cost of a logit: its excess over -margin, with a smooth onset. *slope: the derivative by it.
static float nsvcd__cost_of_logit(float logit, float margin, float *slope) {
  const float x = logit + margin;
  const float soft = NSVCD__SOFT_LOGITS;
  *slope = x <= 0 ? 0 : x < soft ? x / soft : 1;
  return x <= 0 ? 0 : x < soft ? 0.5f * x * x / soft : x - 0.5f * soft;
}

// Adds to the wrenches (B, 6) a wrench on a (6), in b's axes, times `scale`, and the opposite one
// on b. A wrench is the derivative by a pose: by its position, and by a small rotation about that.
// poses: (B).
static void nsvcd__add_wrench_on_pair(const nsvcd_body_pair *pair, const nsvcd_pose *poses,
                                      float scale, const float *wrench, float *wrenches) {
  const nsvcd__mat3 axes = nsvcd__mat3_of(nsvcd__quat_load(poses[pair->b].rotation));
  const nsvcd__f3 force = nsvcd__mat3_apply(&axes, nsvcd__f3_load(wrench));
  const nsvcd__f3 torque = nsvcd__mat3_apply(&axes, nsvcd__f3_load(wrench + 3));
  const nsvcd__f3 from = nsvcd__f3_load(poses[pair->b].position);
  const nsvcd__f3 arm = nsvcd__f3_sub(nsvcd__f3_load(poses[pair->a].position), from);
  const nsvcd__f3 back = nsvcd__f3_add(torque, nsvcd__f3_cross(arm, force));
  nsvcd__add_wrench(scale, force, torque, wrenches + 6 * pair->a);
  nsvcd__add_wrench(-scale, force, back, wrenches + 6 * pair->b);
}

// A logit for any answer. An undecided one counts as a hit.
static float nsvcd__logit_of(const nsvcd_answer *answer) {
  if (answer->verdict != NSVCD_UNDECIDED && answer->opinion.asked)
    return answer->opinion.logit;
  return answer->verdict == NSVCD_FREE ? -NSVCD_LOGIT_CERTAIN : NSVCD_LOGIT_CERTAIN;
}

// The answer about pair k from moment `first` on, over so many segments: by the network, or, in the
// last check, by the method of the options. gradient: (segments + 1, 6), or NULL.
static nsvcd_answer nsvcd__ask_segments(nsvcd__planner *p, uint32_t k, size_t first,
                                        size_t segments, int at_end, float *gradient) {
  const nsvcd_body_pair *pair = &p->in->pairs[k];
  nsvcd_pose motion[NSVCD__RUN_SEGMENTS + 1];
  for (size_t n = 0; n <= segments; n++) {
    const nsvcd_pose *row = p->poses + (first + n) * p->in->body_count;
    motion[n] = nsvcd__relative_pose(&row[pair->a], &row[pair->b]);
  }

  const nsvcd_mover a = {p->in->bodies[pair->a], motion, segments + 1, NULL, 0, {0}};
  const nsvcd_mover b = {p->in->bodies[pair->b], NULL, 0, NULL, 0, {0}};
  nsvcd_question question = p->options.sweep;
  question.a = a;
  question.b = b;
  question.ask = NSVCD_ASK_HIT;
  question.to = question.to_time = 0;
  question.manifold = 0;
  if (!at_end) {
    question.method = NSVCD_METHOD_NETWORK;
    question.clearance = 0;
    question.slop = 0;
    // so that there is a slope before contact
    if (question.network.inflate <= 0) question.network.inflate = NSVCD__PLAN_INFLATE;
  }

  nsvcd_answer answer;
  nsvcd_result error;
  memset(&answer, 0, sizeof answer);
  answer.verdict = NSVCD_FREE;  // on an error
  if (gradient)
    error = nsvcd_sweep_gradient(&question, p->query, p->query_size, &answer, gradient, NULL);
  else
    error = nsvcd_sweep(&question, p->query, p->query_size, &answer);
  if (error) p->error = error;
  p->answer.sweeps++;
  return answer;
}

// How p->poses are asked about.
typedef struct nsvcd__asking {
  size_t moments;
  size_t stride;    // 1: in segments, 0: at moments
  int at_end;       // in the last check
  float limit;      // the sum may stop beyond it
  float *wrenches;  // (moments, B, 6), added to, or NULL
} nsvcd__asking;

// Adds the cost of pair k from moment s to s + stride.
static void nsvcd__add_segment(nsvcd__planner *p, uint32_t k, size_t s,
                               const nsvcd__asking *how, nsvcd__cost *cost) {
  const nsvcd_body_pair *pair = &p->in->pairs[k];
  float gradient[2 * 6];
  float slope;
  float *wanted = how->wrenches ? gradient : NULL;
  const nsvcd_answer answer = nsvcd__ask_segments(p, k, s, how->stride, how->at_end, wanted);
  const float logit = nsvcd__logit_of(&answer);
  const int collides = answer.verdict != NSVCD_FREE;
  if (logit > cost->logit) {
    const int by_proof = answer.by == NSVCD_BY_PROOF;
    const float t = by_proof ? answer.nearest.time : answer.opinion.time;
    const float at = (float)s + (float)how->stride * t;
    cost->logit = logit;
    cost->pair = k;
    // the network does no work
    cost->proven = collides && answer.work > 0;
    cost->time = how->moments > 1 ? at / (float)(how->moments - 1) : 0;
  }
  cost->collides |= collides;
  cost->collision += nsvcd__cost_of_logit(logit, p->options.margin, &slope);
  for (size_t i = 0; wanted && slope > 0 && i <= how->stride; i++) {
    const size_t row = (s + i) * p->in->body_count;
    nsvcd__add_wrench_on_pair(pair, p->poses + row, slope, gradient + 6 * i,
                              how->wrenches + 6 * row);
  }
}

// Adds the cost of pair k along the trajectory.
static void nsvcd__add_pair(nsvcd__planner *p, uint32_t k, const nsvcd__asking *how,
                            nsvcd__cost *cost) {
  const size_t end = how->moments - how->stride;
  const int in_runs = how->stride && !how->at_end;
  size_t asked = 0;  // runs before this segment have been
  nsvcd__find_meetings(p, &p->in->pairs[k], how->moments, how->stride);
  for (size_t s = 0; s < end && cost->collision <= how->limit && !p->error; s++) {
    if (!p->meets[s]) continue;
    if (in_runs && s >= asked) {
      // A run of segments in which the pair may meet, all in one query. If that is far from a
      // collision, the run costs nothing.
      size_t run = 1;
      while (run < NSVCD__RUN_SEGMENTS && s + run < end && p->meets[s + run]) run++;
      asked = s + run;
      if (run > 1) {
        const nsvcd_answer answer = nsvcd__ask_segments(p, k, s, run, 0, NULL);
        if (nsvcd__logit_of(&answer) <= -p->options.margin) {
          s += run - 1;
          continue;
        }
      }
    }
    nsvcd__add_segment(p, k, s, how, cost);
  }
}

// Adds the cost of collision of p->poses, by the problem's own function or by queries, up to the
// first sum above `limit`. wrenches: (moments, B, 6), added to, or NULL. at_end: in the last check.
static void nsvcd__add_collision(nsvcd__planner *p, size_t moments, float limit,
                                 float *wrenches, int at_end, nsvcd__cost *cost) {
  const size_t stride = !p->options.discrete && moments > 1;
  const nsvcd__asking how = {moments, stride, at_end, limit, wrenches};
  if (p->in->collision) {
    cost->collision =
        p->in->collision(p->in->user, p->poses, moments, limit, &cost->collides, wrenches);
    cost->logit = cost->collision;
    return;
  }
  nsvcd__find_stances(p, moments);
  for (size_t n = 0; n < p->in->pair_count && cost->collision <= limit; n++) {
    const uint32_t k = p->queue[n];
    const float before = cost->collision;
    nsvcd__add_pair(p, k, &how, cost);
    // A pair that costs comes earlier next time, so that bad trajectories end early.
    if (n > 0 && cost->collision > before) {
      p->queue[n] = p->queue[n - 1];
      p->queue[n - 1] = k;
    }
  }
}
#endif  // NSVCD_NO_OPTIMIZER
