// In: a pair of parts, a motion of the joints, and their meshes' trees. Out: a certificate that the
// two never meet, as the joints move them.
//
// THE CHORDS. Two parts are seen from the last link that carries both, the base. Let x in [0,1] be
// the fraction of an interval of a piece that has gone by, V_j and A_j bounds of |q_j'| and |q_j''|
// by x, and L_j one of the distance of a point y from joint j: the sum of what stands between them.
// Of a joint that slides L_j is 1. Then
//   |y''| <= sum over j of A_j L_j + V_j (2 sum over outer k of V_k L_k + V_j L_j)
// the second term only for joints that turn, and y leaves its chord by an eighth of it at most. The
// bound of robot/deviation.h, from where the links are, is closer; a checker can compute this one
// again in a few lines. Source: this library.
#pragma once
#include "../interface/pairs.h"
#include "../ground/digests.h"
#include "check.h"

#ifdef NEURALSVCD_CERTIFY_H
// A part, as its motion model sees it.
typedef struct nsvcd__carried {
  const nsvcd_checker *checker;
  nsvcd_joint_motion motion;
  size_t part;
  // the link that it is seen from
  size_t base;
} nsvcd__carried;

// The time in [0,1] at which a piece begins.
static double nsvcd__keyframe_of(const nsvcd_joint_motion *m, size_t piece) {
  const double first = nsvcd__piece_start(m, 0);
  const double whole = nsvcd__piece_start(m, m->pieces) - first;
  return nsvcd__stored((nsvcd__piece_start(m, piece) - first) / whole);
}

// The piece that a time in [0,1] is in.
static size_t nsvcd__keyframe_before(const nsvcd_joint_motion *m, double t) {
  size_t low = 0;
  size_t high = m->pieces;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(nsvcd__keyframe_of(m, middle) <= t ? &low : &high) = middle;
  }
  return low;
}

// The control points of a joint's curve from one time of [0,1] to another, both in a piece. Returns
// a bound of their error, and of that of their differences as the deviation has them, and a
// hundredth more: see ROUNDINGS of examples/verify/nsvcd_verify_robot.h.
static double nsvcd__curve_of(const nsvcd__carried *c, size_t joint, double t0, double t1,
                              double *p) {
  const nsvcd_joint_motion *m = &c->motion;
  const size_t piece = nsvcd__keyframe_before(m, 0.5 * (t0 + t1));
  const double start = nsvcd__keyframe_of(m, piece);
  const double whole = nsvcd__keyframe_of(m, piece + 1) - start;
  const double from = nsvcd__max((t0 - start) / whole, 0);
  const double to = nsvcd__min((t1 - start) / whole, 1);
  double most = 0;
  nsvcd__joint_points(m, piece, c->checker->scene->joint_count, joint, p);
  for (size_t i = 0; i <= m->degree; i++) most = nsvcd__max(most, fabs(p[i]));
  nsvcd__cut_curve(p, m->degree, from, to);
  return 5.05e-13 * most;
}

static nsvcd_pose64 nsvcd__carried_pose(const void *motion, double t) {
  const nsvcd__carried *c = (const nsvcd__carried *)motion;
  const nsvcd_scene *scene = c->checker->scene;
  nsvcd__dpose at = c->checker->members[c->part].frame;
  for (size_t link = scene->parts[c->part].link; link != c->base;
       link = scene->joints[link - 1].parent) {
    double q[NSVCD_MAX_DEGREE + 1];
    (void)nsvcd__curve_of(c, link - 1, t, t, q);
    const nsvcd__dpose carrier = nsvcd__joint_frame(c->checker, link - 1, q[0]);
    at = nsvcd__dpose_mul(&carrier, &at);
  }
  const nsvcd_pose64 out = {{at.position.x, at.position.y, at.position.z},
                            {at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w}};
  return out;
}

static double nsvcd__carried_next(const void *motion, double t) {
  const nsvcd_joint_motion *m = &((const nsvcd__carried *)motion)->motion;
  return nsvcd__keyframe_of(m, nsvcd__keyframe_before(m, t) + 1);
}

// THE CHORDS of the banner. Each sum is a pair: `base` does not depend on the distance from the
// part's origin, `per_metre` goes with it.
static nsvcd_deviation nsvcd__carried_deviation(const void *motion, double t0, double t1) {
  const nsvcd__carried *c = (const nsvcd__carried *)motion;
  const nsvcd_scene *scene = c->checker->scene;
  const size_t degree = c->motion.degree;
  const double n = (double)degree;
  double between = nsvcd__d3_norm(c->checker->members[c->part].frame.position);
  nsvcd_deviation outer, out;
  memset(&outer, 0, sizeof outer);
  memset(&out, 0, sizeof out);
  for (size_t link = scene->parts[c->part].link; link != c->base;
       link = scene->joints[link - 1].parent) {
    const int slides = nsvcd__slides(c->checker, link - 1);
    const double per_metre = slides ? 0 : 1;
    const double base = slides ? 1 : between;
    double p[NSVCD_MAX_DEGREE + 1];
    double most = 0;
    double speed = 0;
    double bend = 0;
    const double error = nsvcd__curve_of(c, link - 1, t0, t1, p);
    for (size_t i = 0; i <= degree; i++) {
      most = nsvcd__max(most, fabs(p[i]));
      if (i >= 1) speed = nsvcd__max(speed, n * fabs(p[i] - p[i - 1]));
      if (i >= 2) bend = nsvcd__max(bend, n * (n - 1) * fabs(p[i] - 2 * p[i - 1] + p[i - 2]));
    }
    most += error;
    speed += error;
    bend += error;
    const double own = slides ? 0 : speed;
    out.base += bend * base + own * (2 * outer.base + own * base);
    out.per_metre += bend * per_metre + own * (2 * outer.per_metre + own * per_metre);
    outer.base += speed * base;
    outer.per_metre += speed * per_metre;
    const nsvcd__link *carrier = &c->checker->links[link - 1];
    between += nsvcd__d3_norm(carrier->origin.position) + (slides ? most : 0);
  }
  out.base *= 0.1250001;
  out.per_metre *= 0.1250001;
  return out;
}

// The lower half of a double first, whatever the machine's order.
static uint32_t nsvcd__digest_double(uint32_t digest, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  const uint32_t halves[2] = {(uint32_t)bits, (uint32_t)(bits >> 32)};
  return nsvcd__digest(digest, halves, 2);
}

// With a digest of what carries the part, and as `extent` a bound of all lengths between it and the
// base.
static nsvcd_motion_model nsvcd__carried_model(const nsvcd__carried *c) {
  const nsvcd_scene *scene = c->checker->scene;
  const nsvcd_part *part = &scene->parts[c->part];
  const nsvcd_joint_motion *m = &c->motion;
  const float scale = part->scale > 0 ? part->scale : 1;
  double extent = nsvcd__d3_norm(c->checker->members[c->part].frame.position);
  uint32_t d = nsvcd__digest((uint32_t)c->base, part->pose.position, 7);
  d = nsvcd__digest(d, &scale, 1);
  for (size_t link = part->link; link != c->base; link = scene->joints[link - 1].parent) {
    const nsvcd_joint *joint = &scene->joints[link - 1];
    const uint32_t slides = joint->kind == NSVCD_JOINT_PRISMATIC;
    double most = 0;
    d = nsvcd__digest(d + slides, joint->origin.position, 7);
    d = nsvcd__digest(d + (uint32_t)link, joint->axis, 3);
    for (size_t i = 0; i <= m->pieces * m->degree; i++) {
      const double value = m->points[i * scene->joint_count + link - 1];
      d = nsvcd__digest_double(d, value);
      most = nsvcd__max(most, fabs(value));
    }
    const nsvcd__link *carrier = &c->checker->links[link - 1];
    extent += nsvcd__d3_norm(carrier->origin.position) + (slides ? most : 0);
  }
  d += (uint32_t)m->degree;
  for (size_t i = 0; i <= m->pieces; i++)
    d = nsvcd__digest_double(d, nsvcd__piece_start(m, i));
  const nsvcd_motion_model model = {(double)scale,
                                    nsvcd__carried_pose,
                                    nsvcd__carried_next,
                                    nsvcd__carried_deviation,
                                    c,
                                    extent,
                                    d};
  return model;
}

// Are there pieces, and has a double digits left for their angles and times?
static int nsvcd__is_provable(const nsvcd_checker *c, const nsvcd_joint_motion *m) {
  const size_t joints = c->scene->joint_count;
  if (m->pieces < 1 || m->pieces > NSVCD_MAX_POSES) return 0;
  for (size_t i = 0; i <= m->pieces * m->degree; i++) {
    const size_t piece = i > 0 ? (i - 1) / m->degree : 0;
    const double whole = nsvcd__keyframe_of(m, piece + 1) - nsvcd__keyframe_of(m, piece);
    if (!(whole >= 1.001e-9)) return 0;
    for (size_t j = 0; j < joints; j++) {
      const double *value = &m->points[i * joints + j];
      const double speed = i > 0 ? (double)m->degree * fabs(*value - *(value - joints)) : 0;
      if (!nsvcd__slides(c, j) && !(fabs(*value) <= 250)) return 0;
      if (!(speed <= 0.999e5 * whole)) return 0;
    }
  }
  return 1;
}

NSVCDDEF size_t nsvcd_certify_pair_workspace_size(const nsvcd_joint_motion *motion,
                                                  const nsvcd_tree *a, const nsvcd_tree *b) {
  return motion ? nsvcd_certify_models_workspace_size(motion->pieces + 1, a, b) : 0;
}

NSVCDDEF nsvcd_result nsvcd_certify_pair(const nsvcd_checker *checker,
                                         const nsvcd_joint_motion *motion, size_t pair,
                                         float clearance, const nsvcd_tree *a,
                                         const nsvcd_tree *b,
                                         const nsvcd_certify_options *options, void *workspace,
                                         size_t workspace_size, uint8_t *bytes,
                                         size_t capacity, nsvcd_certificate *made) {
  if (!checker || !motion || !a || !b || !made || (capacity > 0 && !bytes))
    return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  if (!motion->points) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_result result = nsvcd__motion_check(scene, motion);
  if (result) return result;
  if (pair >= scene->pair_count) return NSVCD_ERROR_PAIR;
  if (!nsvcd__is_provable(checker, motion)) return NSVCD_ERROR_TURN;
  const nsvcd_body_pair *parts = &scene->pairs[pair];
  const size_t base =
      nsvcd__common_link(scene, scene->parts[parts->a].link, scene->parts[parts->b].link);
  const nsvcd__carried carried[2] = {{checker, *motion, parts->a, base},
                                     {checker, *motion, parts->b, base}};
  const nsvcd_motion_model models[2] = {nsvcd__carried_model(&carried[0]),
                                        nsvcd__carried_model(&carried[1])};
  return nsvcd_certify_models(models, motion->pieces + 1, clearance, a, b, options, workspace,
                              workspace_size, bytes, capacity, made);
}
#endif  // NEURALSVCD_CERTIFY_H
