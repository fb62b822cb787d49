// In: a checker and a motion of its joints. Out: is it free, as the joints make it, at all times?
#pragma once
#include "stray.h"

#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_ROBOTS)
// ---- a checker

// Is x a number, and no larger? By the bits, which are in the order of what is not negative.
static int nsvcd__is_number(double x, double most) {
  uint64_t bits, limit;
  memcpy(&bits, &x, sizeof bits);
  memcpy(&limit, &most, sizeof limit);
  return (bits & ~(uint64_t)0 >> 1) <= limit;
}

static nsvcd_result nsvcd__joint_check(const nsvcd_joint *joint, size_t i) {
  double axis = 0;
  if (joint->parent > i || (unsigned)joint->kind > NSVCD_JOINT_PRISMATIC)
    return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < 3; k++) {
    if (!nsvcd__is_finite(joint->axis[k])) return NSVCD_ERROR_NUMBER;
    axis = nsvcd__max(axis, fabs((double)joint->axis[k]));
  }
  if (!(axis > 1e-15) || axis > 1e15) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__poses_are_valid(&joint->origin, 1)) return NSVCD_ERROR_POSE;
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return NSVCD_OK;
  const double most = (double)NSVCD_MAX_COORDINATE;
  if (!nsvcd__is_number(joint->low, most) || !nsvcd__is_number(joint->high, most))
    return NSVCD_ERROR_NUMBER;
  return joint->low <= joint->high ? NSVCD_OK : NSVCD_ERROR_ARGUMENT;
}

static nsvcd_result nsvcd__part_check(const nsvcd_scene *scene, const nsvcd_part *part) {
  if (!part->body || part->link > scene->joint_count) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__triangles_of(part->body)) return NSVCD_ERROR_BODY;
  const float scale = part->scale;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE;
  if (!(fits || (scale <= 0 && scale >= 0))) return NSVCD_ERROR_SCALE;
  return nsvcd__poses_are_valid(&part->pose, 1) ? NSVCD_OK : NSVCD_ERROR_POSE;
}

static nsvcd_result nsvcd__scene_check(const nsvcd_scene *scene) {
  nsvcd_result result = NSVCD_OK;
  if (!scene || scene->joint_count < 1 || scene->joint_count > NSVCD_MAX_JOINTS)
    return NSVCD_ERROR_ARGUMENT;
  if (!scene->joints || scene->part_count > NSVCD_MAX_PARTS) return NSVCD_ERROR_ARGUMENT;
  if ((scene->part_count > 0 && !scene->parts) || (scene->pair_count > 0 && !scene->pairs))
    return NSVCD_ERROR_ARGUMENT;
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__joint_check(&scene->joints[i], i);
  for (size_t n = 0; n < scene->part_count && !result; n++)
    result = nsvcd__part_check(scene, &scene->parts[n]);
  for (size_t k = 0; k < scene->pair_count && !result; k++) {
    const nsvcd_body_pair *pair = &scene->pairs[k];
    if (pair->a >= scene->part_count || pair->b >= scene->part_count)
      return NSVCD_ERROR_ARGUMENT;
    if (scene->parts[pair->a].link == scene->parts[pair->b].link) return NSVCD_ERROR_ARGUMENT;
  }
  return result;
}

// Lays a checker out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes; 0 if they are more than can be counted.
static size_t nsvcd__checker_layout(const nsvcd_scene *scene, char *base,
                                    nsvcd_checker **checker) {
  nsvcd_checker counted;
  uint64_t used = 0;
  size_t movers = 0;
  for (size_t n = 0; n < scene->part_count; n++) movers += scene->parts[n].link > 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd_checker));
  nsvcd_checker *c = at ? (nsvcd_checker *)at : &counted;
  const size_t parts = scene->part_count;
  const size_t pairs = scene->pair_count;
  const size_t samples = NSVCD__MOST_STEPS + 1;
  c->mover_count = movers;
  c->members = (nsvcd__member *)nsvcd__take(base, &used, parts, sizeof(nsvcd__member));
  c->order = (uint32_t *)nsvcd__take(base, &used, pairs, sizeof(uint32_t));
  c->left = (uint32_t *)nsvcd__take(base, &used, pairs, sizeof(uint32_t));
  c->poses = (nsvcd_pose *)nsvcd__take(base, &used, movers * samples, sizeof(nsvcd_pose));
  c->centres = (nsvcd__d3 *)nsvcd__take(base, &used, movers * samples, sizeof(nsvcd__d3));
  c->query_size = nsvcd_sweep_workspace_size(NULL);
  c->query = nsvcd__take(base, &used, 1, c->query_size);
  *checker = c;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene) {
  nsvcd_checker *unused;
  return nsvcd__scene_check(scene) ? 0 : nsvcd__checker_layout(scene, NULL, &unused);
}

NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker) {
  nsvcd_checker *c;
  const nsvcd_result result = nsvcd__scene_check(scene);
  if (result) return result;
  if (!checker) return NSVCD_ERROR_ARGUMENT;
  if (!memory || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  const size_t needed = nsvcd__checker_layout(scene, NULL, &c);
  if (!needed || size < needed) return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__checker_layout(scene, (char *)memory, &c);
  c->scene = scene;
  for (size_t i = 0; i < scene->joint_count; i++) {
    const nsvcd_joint *joint = &scene->joints[i];
    const nsvcd__frame origin = nsvcd__frame_of(&joint->origin);
    nsvcd__link *link = &c->links[i];
    link->place = origin.place;
    link->turn = origin.turn;
    link->axis = nsvcd__d3_unit(nsvcd__d3_load(joint->axis), nsvcd__d3_of(0, 0, 1));
    link->path = (uint32_t)1 << i | (joint->parent ? c->links[joint->parent - 1].path : 0);
  }
  size_t row = 0;
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd_part *part = &scene->parts[n];
    const double scale = part->scale > 0 ? (double)part->scale : 1;
    nsvcd__member *m = &c->members[n];
    m->frame = nsvcd__frame_of(&part->pose);
    const nsvcd__d3 centre = nsvcd__d3_scale(nsvcd__d3_load(part->body->centre), scale);
    const nsvcd__frame sphere = {{0, 0, 0, 1}, centre};
    m->centre = nsvcd__frame_in(&m->frame, &sphere).place;
    // spheres are reckoned in float
    m->radius = 1.000001 * scale * (double)part->body->radius;
    m->whole_radius = 1.000001 * scale * (double)nsvcd__whole_radius(part->body);
    m->extent = 1.000001 * scale * (double)part->body->extent;
    m->row = part->link ? NSVCD__MOST_STEPS + 1 : 0;
    m->row *= row;
    row += part->link > 0;
  }
  for (size_t k = 0; k < scene->pair_count; k++) c->order[k] = (uint32_t)k;
  *checker = c;
  return NSVCD_OK;
}

// ---- samples of a piece

// The part of a piece from share s0 to s1: de Casteljau's algorithm, twice.
static void nsvcd__step_cut(const double *points, size_t degree, size_t joints, double s0,
                            double s1, nsvcd__step *step) {
  const double before = s1 > 0 ? s0 / s1 : 0;
  for (size_t j = 0; j < joints; j++) {
    double p[NSVCD_MAX_DEGREE + 1];
    for (size_t i = 0; i <= degree; i++) p[i] = points[i * joints + j];
    // the first s1 of it: p[i] becomes the point of level i
    for (size_t level = 1; level <= degree && s1 < 1; level++) {
      for (size_t i = degree; i >= level; i--) p[i] = p[i - 1] + s1 * (p[i] - p[i - 1]);
    }
    // of that, what is after s0
    for (size_t level = 1; level <= degree && before > 0; level++) {
      for (size_t i = 0; i + level <= degree; i++) p[i] = p[i] + before * (p[i + 1] - p[i]);
    }
    for (size_t i = 0; i <= degree; i++) step->points[i][j] = p[i];
  }
  nsvcd__step_measure(step, degree, joints);
}

// Cuts a stretch of a piece, from share s0 to s1, into so many steps, and fills in, for each part
// that moves, its samples, and by how much it strays between them.
static void nsvcd__sample(nsvcd_checker *c, const double *points, size_t degree, double s0,
                          double s1, size_t steps) {
  const nsvcd_scene *scene = c->scene;
  nsvcd__step step;
  nsvcd__configuration *from = &c->at;
  nsvcd__configuration *to = &c->next;
  for (size_t n = 0; n < scene->part_count; n++) c->members[n].stray = 0;
  for (size_t k = 0; k <= steps; k++) {
    if (k < steps) {
      const double from_share = s0 + (s1 - s0) * (double)k / (double)steps;
      const double to_share =
          k + 1 < steps ? s0 + (s1 - s0) * (double)(k + 1) / (double)steps : s1;
      nsvcd__step_cut(points, degree, scene->joint_count, from_share, to_share, &step);
    }
    if (k == 0) {
      memcpy(from->joints, step.points[0], sizeof from->joints);
      nsvcd__place_links(c, from);
    }
    if (k < steps) {
      memcpy(to->joints, step.points[degree], sizeof to->joints);
      nsvcd__place_links(c, to);
    }
    for (size_t n = 0; n < scene->part_count; n++) {
      nsvcd__member *m = &c->members[n];
      const size_t link = scene->parts[n].link;
      if (!link) continue;
      const nsvcd__frame frame = nsvcd__frame_in(&from->frames[link], &m->frame);
      const nsvcd__frame sphere = {{0, 0, 0, 1}, m->centre};
      c->poses[m->row + k] = nsvcd__pose_in(&frame);
      c->centres[m->row + k] = nsvcd__frame_in(&from->frames[link], &sphere).place;
      // places and quaternions as floats are off by no more
      const double rounding = 1.1e-7 * nsvcd__d3_length(frame.place) + 1.3e-7 * m->extent;
      double stray = 0;
      if (k < steps) stray = nsvcd__stray_of(c, n, &step, from, to);
      m->stray = nsvcd__max(m->stray, stray * (1 + 1e-9) + 2 * rounding);
    }
    nsvcd__configuration *other = from;
    from = to;
    to = other;
  }
}

// ---- pairs

static nsvcd_mover nsvcd__mover_of(const nsvcd_checker *c, size_t part, size_t poses) {
  const nsvcd_part *p = &c->scene->parts[part];
  nsvcd_mover mover;
  memset(&mover, 0, sizeof mover);
  mover.body = p->body;
  mover.scale = p->scale;
  mover.poses = p->link ? &c->poses[c->members[part].row] : &p->pose;
  mover.count = p->link ? poses : 1;
  return mover;
}

// Where the centre of a part's sphere is at a sample.
static nsvcd__d3 nsvcd__centre_at(const nsvcd_checker *c, size_t part, size_t sample) {
  const nsvcd__member *m = &c->members[part];
  return c->scene->parts[part].link ? c->centres[m->row + sample] : m->centre;
}

// Do two spheres stay apart, by more than `room` between their centres, in all steps?
static int nsvcd__stay_apart(const nsvcd_checker *c, const nsvcd_body_pair *pair, size_t steps,
                             double room) {
  nsvcd__d3 from =
      nsvcd__d3_sub(nsvcd__centre_at(c, pair->a, 0), nsvcd__centre_at(c, pair->b, 0));
  for (size_t k = 1; k <= steps + !steps; k++) {
    const size_t at = k < steps ? k : steps;
    const nsvcd__d3 to =
        nsvcd__d3_sub(nsvcd__centre_at(c, pair->a, at), nsvcd__centre_at(c, pair->b, at));
    const nsvcd__d3 way = nsvcd__d3_sub(to, from);
    const double square = nsvcd__d3_dot(way, way);
    const double share = square > 0 ? -nsvcd__d3_dot(from, way) / square : 0;
    const double u = nsvcd__max(0, nsvcd__min(1, share));
    const nsvcd__d3 nearest = nsvcd__d3_fma(u, way, from);
    if (!(nsvcd__d3_dot(nearest, nearest) > room * room)) return 0;
    from = to;
  }
  return 1;
}

// Asks about a pair, in the poses of so many steps, whether it comes as near as the clearance and
// `strays` more.
static nsvcd_result nsvcd__ask_pair(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                    size_t steps, double strays,
                                    const nsvcd_check_options *options, nsvcd_answer *found,
                                    nsvcd_check_answer *answer) {
  const double clearance = (double)options->clearance + strays;
  const double whole =
      c->members[pair->a].whole_radius + c->members[pair->b].whole_radius + clearance;
  nsvcd_question question;
  if (nsvcd__stay_apart(c, pair, steps, whole * (1 + 1e-9))) {
    found->verdict = NSVCD_FREE;
    return NSVCD_OK;
  }
  memset(&question, 0, sizeof question);
  question.a = nsvcd__mover_of(c, pair->a, steps + 1);
  question.b = nsvcd__mover_of(c, pair->b, steps + 1);
  question.clearance = clearance > 0 ? nsvcd__round_outward(clearance) : 0;
  question.method = NSVCD_METHOD_PROOF;
  question.work = options->work;
  answer->sweeps++;
  return nsvcd_sweep(&question, c->query, c->query_size, found);
}

// Is a pair hit in one configuration? Then the answer says so.
static nsvcd_result nsvcd__ask_at(nsvcd_checker *c, size_t pair, const double *joints,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_answer found;
  nsvcd_question question;
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  const size_t parts[2] = {both->a, both->b};
  nsvcd_pose poses[2];
  memcpy(c->at.joints, joints, c->scene->joint_count * sizeof *joints);
  nsvcd__place_links(c, &c->at);
  memset(&question, 0, sizeof question);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_part *part = &c->scene->parts[parts[n]];
    nsvcd_mover *mover = n ? &question.b : &question.a;
    const nsvcd__frame frame =
        nsvcd__frame_in(&c->at.frames[part->link], &c->members[parts[n]].frame);
    poses[n] = part->link ? nsvcd__pose_in(&frame) : part->pose;
    mover->body = part->body;
    mover->scale = part->scale;
    mover->poses = &poses[n];
    mover->count = 1;
  }
  question.clearance = options->clearance;
  question.method = NSVCD_METHOD_PROOF;
  question.work = options->work;
  answer->sweeps++;
  answer->placed++;
  const nsvcd_result result = nsvcd_sweep(&question, c->query, c->query_size, &found);
  if (result || found.verdict != NSVCD_HIT) return result;
  answer->verdict = NSVCD_HIT;
  answer->contact = found.nearest;
  return NSVCD_OK;
}

// Puts a pair first in the order.
static void nsvcd__put_first(nsvcd_checker *c, size_t pair) {
  size_t at = 0;
  while (c->order[at] != pair) at++;
  for (; at > 0; at--) c->order[at] = c->order[at - 1];
  c->order[0] = (uint32_t)pair;
}

// A stretch of a piece, from share s0 to s1, or, where the degree is 0, one configuration. What
// takes too many steps is halved, so often at most.
static nsvcd_result nsvcd__check_stretch(nsvcd_checker *c, const double *points, size_t degree,
                                         double s0, double s1, int halvings,
                                         const nsvcd_check_options *options,
                                         nsvcd_check_answer *answer) {
  const size_t joints = c->scene->joint_count;
  size_t steps = degree > 0;
  size_t left = c->scene->pair_count;
  double allowed = NSVCD__COARSE;
  nsvcd_answer found;
  nsvcd__step step;
  memcpy(c->left, c->order, left * sizeof *c->left);
  nsvcd__sample(c, points, degree, s0, s1, steps);
  answer->placed += steps + 1;
  while (left > 0) {
    double most = 0;
    for (size_t n = 0; n < c->scene->part_count; n++) most = fmax(most, c->members[n].stray);
    // strays go by the square of a step
    const double finer = ceil(sqrt(most / allowed));
    const double wanted = finer * (double)steps;
    if (wanted > NSVCD__MOST_STEPS && halvings > 0) {
      const double middle = 0.5 * (s0 + s1);
      const nsvcd_result result =
          nsvcd__check_stretch(c, points, degree, s0, middle, halvings - 1, options, answer);
      if (result || answer->verdict != NSVCD_FREE) return result;
      answer->verdict = NSVCD_UNDECIDED;
      return nsvcd__check_stretch(c, points, degree, middle, s1, halvings - 1, options,
                                  answer);
    }
    if (degree > 0 && finer > 1) {
      steps = wanted < NSVCD__MOST_STEPS ? (size_t)wanted : NSVCD__MOST_STEPS;
      nsvcd__sample(c, points, degree, s0, s1, steps);
      answer->placed += steps + 1;
    }
    size_t kept = 0;
    for (size_t n = 0; n < left; n++) {
      const size_t pair = c->left[n];
      const nsvcd_body_pair *both = &c->scene->pairs[pair];
      double strays = c->members[both->a].stray + c->members[both->b].stray;
      nsvcd_result result = nsvcd__ask_pair(c, both, steps, strays, options, &found, answer);
      if (!result && found.verdict == NSVCD_FREE) continue;
      answer->pair = pair;
      answer->why = found.why;
      // as near as this where it is proven so far: is it hit there, or where the samples' way is?
      for (int look = 0; look < 2 && !result && found.verdict != NSVCD_FREE; look++) {
        const double time = steps ? fmin(fmax((double)found.nearest.time, 0), 1) : 0;
        const double share = s0 + (s1 - s0) * time;
        nsvcd__step_cut(points, degree, joints, 0, share, &step);
        answer->share = share;
        result = nsvcd__ask_at(c, pair, step.points[degree], options, answer);
        if (!result && answer->verdict == NSVCD_HIT) {
          nsvcd__put_first(c, pair);
          return NSVCD_OK;
        }
        if (look == 0 && !result)
          result = nsvcd__ask_pair(c, both, steps, 0, options, &found, answer);
      }
      if (result) return result;
      c->left[kept++] = (uint32_t)pair;
    }
    left = kept;
    if (left == 0) break;
    if (steps == 0 || steps == NSVCD__MOST_STEPS || allowed <= (double)options->finest)
      return NSVCD_OK;
    allowed = fmax(allowed / NSVCD__STRAY_SHARE, (double)options->finest);
  }
  answer->pair = NSVCD_NONE;
  answer->verdict = NSVCD_FREE;
  return NSVCD_OK;
}

// Does a joint leave its limits in a piece? Halved until it is within at all its points, or out at
// an end.
static int nsvcd__leaves(const double *points, size_t degree, double low, double high,
                         int depth) {
  double first[NSVCD_MAX_DEGREE + 1], second[NSVCD_MAX_DEGREE + 1];
  int within = 1;
  for (size_t i = 0; i <= degree; i++) within &= points[i] >= low && points[i] <= high;
  if (within) return 0;
  if (depth == 0 || !(points[0] >= low && points[0] <= high)) return 1;
  if (!(points[degree] >= low && points[degree] <= high)) return 1;
  memcpy(second, points, (degree + 1) * sizeof *points);
  first[0] = second[0];
  for (size_t level = 1; level <= degree; level++) {
    for (size_t i = 0; i + level <= degree; i++) second[i] = 0.5 * (second[i] + second[i + 1]);
    first[level] = second[0];
  }
  return nsvcd__leaves(first, degree, low, high, depth - 1) ||
         nsvcd__leaves(second, degree, low, high, depth - 1);
}

// A joint that leaves its limits by more than rounding, or NSVCD_NONE.
static size_t nsvcd__joint_outside(const nsvcd_scene *scene, const double *points,
                                   size_t degree) {
  double own[NSVCD_MAX_DEGREE + 1];
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    for (size_t i = 0; i <= degree; i++) own[i] = points[i * scene->joint_count + j];
    const double off = 1e-9 * (1 + fabs(joint->low) + fabs(joint->high));
    if (nsvcd__leaves(own, degree, joint->low - off, joint->high + off, 30)) return j;
  }
  return NSVCD_NONE;
}

NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_check_answer found;
  nsvcd_check_options o;
  if (!checker || !motion || !answer || !motion->points) return NSVCD_ERROR_ARGUMENT;
  const size_t joints = checker->scene->joint_count;
  const size_t degree = motion->pieces ? motion->degree : 0;
  if (motion->pieces && (degree < 1 || degree > NSVCD_MAX_DEGREE)) return NSVCD_ERROR_ARGUMENT;
  if (motion->pieces > SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints)
    return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < (motion->pieces * degree + 1) * joints; k++) {
    if (!nsvcd__is_number(motion->points[k], (double)NSVCD_MAX_COORDINATE))
      return NSVCD_ERROR_NUMBER;
  }
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_finite(o.clearance) || !nsvcd__is_finite(o.finest) || o.clearance < 0 ||
      o.finest < 0)
    return NSVCD_ERROR_TOLERANCE;
  o.finest = o.finest > 0 ? o.finest : NSVCD__FINEST;
  memset(&found, 0, sizeof found);
  found.joint = found.pair = found.piece = NSVCD_NONE;
  for (size_t p = 0; p < motion->pieces + !motion->pieces; p++) {
    const double *points = motion->points + p * degree * joints;
    if (found.joint == NSVCD_NONE)
      found.joint = nsvcd__joint_outside(checker->scene, points, degree);
    found.verdict = NSVCD_UNDECIDED;
    const nsvcd_result result = nsvcd__check_stretch(checker, points, degree, 0, degree > 0,
                                                     NSVCD__STRETCHES, &o, &found);
    if (result) return result;
    found.piece = p;
    if (found.verdict != NSVCD_FREE) break;
  }
  if (found.verdict == NSVCD_FREE) {
    found.piece = NSVCD_NONE;
    found.share = 0;
    found.why = NSVCD_WHY_NOTHING;
  }
  *answer = found;
  return NSVCD_OK;
}
#endif  // NSVCD_NO_PROOF, NSVCD_NO_ROBOTS
