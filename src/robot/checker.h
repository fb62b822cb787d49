// In: a scene. Out: its checker, in the caller's memory; or what is wrong with it.
#pragma once
#include "deviation.h"

// ---- is a scene in order?

// Finite, and no larger than a coordinate may be? By their bits, so that it holds under -ffast-math
// too: those of numbers that are not negative are in the order of the numbers.
static int nsvcd__are_numbers(const double *x, size_t count) {
  const double most = (double)NSVCD_MAX_COORDINATE;
  uint64_t bits, limit;
  memcpy(&limit, &most, sizeof limit);
  for (size_t i = 0; i < count; i++) {
    memcpy(&bits, &x[i], sizeof bits);
    if ((bits & ~(uint64_t)0 >> 1) > limit) return 0;
  }
  return 1;
}

// Is a direction finite, and of some length?
static int nsvcd__is_direction(const float *x) {
  double most = 0;
  for (size_t k = 0; k < 3; k++) most = nsvcd__max(most, fabs((double)x[k]));
  return nsvcd__in_range(x, 3, 1e15f) && most > 1e-15;
}

static nsvcd_result nsvcd__joint_check(const nsvcd_joint *joint, size_t i) {
  if (joint->parent > i || (unsigned)joint->kind > NSVCD_JOINT_PRISMATIC)
    return NSVCD_ERROR_JOINT;
  if (!nsvcd__is_direction(joint->axis)) return NSVCD_ERROR_AXIS;
  const nsvcd_result result = nsvcd__poses_check(&joint->origin, 1);
  if (result) return result;
  const double rates[2] = {joint->speed, joint->acceleration};
  if (!nsvcd__are_numbers(rates, 2) || rates[0] < 0 || rates[1] < 0) return NSVCD_ERROR_SPEED;
  const double limits[2] = {joint->low, joint->high};
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return NSVCD_OK;
  const int fits = nsvcd__are_numbers(limits, 2) && limits[0] <= limits[1];
  return fits ? NSVCD_OK : NSVCD_ERROR_LIMITS;
}

// Is a joint that mimics another in order? A full turn of a leader without limits has to bring back
// what follows it.
static nsvcd_result nsvcd__mimic_check(const nsvcd_scene *scene, const nsvcd_joint *joint) {
  const double numbers[2] = {joint->multiplier, joint->offset};
  if (!joint->mimic) return NSVCD_OK;
  if (joint->mimic > scene->joint_count || !nsvcd__are_numbers(numbers, 2))
    return NSVCD_ERROR_MIMIC;
  const nsvcd_joint *leader = &scene->joints[joint->mimic - 1];
  const double rate = fabs(joint->multiplier);
  const int is_endless =
      joint->kind == NSVCD_JOINT_CONTINUOUS && leader->kind == NSVCD_JOINT_CONTINUOUS;
  // so it is not itself either
  if (leader->mimic || !(rate >= NSVCD__LEAST_MULTIPLIER)) return NSVCD_ERROR_MIMIC;
  return is_endless && rate > floor(rate) ? NSVCD_ERROR_MIMIC : NSVCD_OK;
}

static nsvcd_result nsvcd__allowance_check(const nsvcd_scene *scene,
                                           const nsvcd_allowance *allowance) {
  if (allowance->pair >= scene->pair_count) return NSVCD_ERROR_PAIR;
  if (!allowance->joints) return NSVCD_ERROR_ARGUMENT;
  if (!nsvcd__are_numbers(allowance->joints, scene->joint_count)) return NSVCD_ERROR_VALUE;
  if (!nsvcd__are_numbers(&allowance->distance, 1) || allowance->distance < 0)
    return NSVCD_ERROR_DISTANCE;
  return NSVCD_OK;
}

static nsvcd_result nsvcd__part_check(const nsvcd_scene *scene, const nsvcd_part *part) {
  const nsvcd_body *body = NULL;
  const nsvcd_result result = nsvcd_body_trust(part->body, SIZE_MAX, &body);
  if (result) return result;
  if (part->link > scene->joint_count) return NSVCD_ERROR_LINK;
  if (!nsvcd_body_describe(body).triangles) return NSVCD_ERROR_TRIANGLES;
  const float scale = part->scale;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE;
  if (!(fits || (scale <= 0 && scale >= 0))) return NSVCD_ERROR_SCALE;
  return nsvcd__poses_check(&part->pose, 1);
}

// Are the allowances and the cones of a scene in order, of which all else is?
static nsvcd_result nsvcd__extras_check(const nsvcd_scene *scene) {
  if (scene->allowance_count > 0 && !scene->allowances) return NSVCD_ERROR_ARGUMENT;
  for (size_t n = 0; n < scene->allowance_count; n++) {
    const nsvcd_result result = nsvcd__allowance_check(scene, &scene->allowances[n]);
    if (result) return result;
  }
  if (scene->cone_count > 0 && !scene->cones) return NSVCD_ERROR_ARGUMENT;
  for (size_t n = 0; n < scene->cone_count; n++) {
    const nsvcd_cone *cone = &scene->cones[n];
    if (cone->part >= scene->part_count) return NSVCD_ERROR_LINK;
    if (!nsvcd__is_direction(cone->axis) || !nsvcd__is_direction(cone->direction))
      return NSVCD_ERROR_AXIS;
    if (!nsvcd__are_numbers(&cone->angle, 1) ||
        !(cone->angle > 0 && cone->angle < 3.141592653589793))
      return NSVCD_ERROR_CONE;
  }
  return NSVCD_OK;
}

static nsvcd_result nsvcd__scene_check(const nsvcd_scene *scene) {
  nsvcd_result result = NSVCD_OK;
  if (!scene) return NSVCD_ERROR_ARGUMENT;
  const size_t parts = scene->part_count;
  if (scene->joint_count < 1 || scene->joint_count > NSVCD_MAX_JOINTS ||
      parts > NSVCD_MAX_PARTS)
    return NSVCD_ERROR_COUNT;
  if (!scene->joints || (parts > 0 && !scene->parts) ||
      (scene->pair_count > 0 && !scene->pairs))
    return NSVCD_ERROR_ARGUMENT;
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__joint_check(&scene->joints[i], i);
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__mimic_check(scene, &scene->joints[i]);
  for (size_t i = 0; i < scene->joint_count && !result; i++) {
    const nsvcd_joint joint = nsvcd__narrowed(scene, i);
    result = nsvcd__joint_check(&joint, i);
  }
  for (size_t n = 0; n < parts && !result; n++)
    result = nsvcd__part_check(scene, &scene->parts[n]);
  for (size_t k = 0; k < scene->pair_count && !result; k++) {
    const nsvcd_body_pair *pair = &scene->pairs[k];
    if (pair->a >= parts || pair->b >= parts ||
        scene->parts[pair->a].link == scene->parts[pair->b].link)
      return NSVCD_ERROR_PAIR;
    if (scene->clearances && !nsvcd__is_length(scene->clearances[k]))
      return NSVCD_ERROR_CLEARANCE;
  }
  return result ? result : nsvcd__extras_check(scene);
}

// ---- boxes

// Of a part whose frame in the world this is.
static nsvcd__bounds nsvcd__bounds_of(const nsvcd__member *m, const nsvcd__dpose *frame) {
  const nsvcd__dmat3 axes = nsvcd__dmat3_of(frame->rotation);
  const nsvcd__d3 *rows[3] = {&axes.x, &axes.y, &axes.z};
  nsvcd__d3 half = {0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 row = {fabs(rows[k]->x), fabs(rows[k]->y), fabs(rows[k]->z)};
    nsvcd__d3_set_axis(&half, k, nsvcd__d3_dot(row, m->half));
  }
  const nsvcd__d3 middle =
      nsvcd__d3_add(nsvcd__dmat3_apply(&axes, m->middle), frame->position);
  const nsvcd__bounds out = {nsvcd__d3_sub(middle, half), nsvcd__d3_add(middle, half)};
  return out;
}

static nsvcd__bounds nsvcd__bounds_over(const nsvcd__bounds *a, const nsvcd__bounds *b) {
  nsvcd__bounds out;
  out.low = nsvcd__d3_min(a->low, b->low);
  out.high = nsvcd__d3_max(a->high, b->high);
  return out;
}

// Are two boxes more than `room` apart along an axis?
static int nsvcd__bounds_apart(const nsvcd__bounds *a, const nsvcd__bounds *b, double room) {
  const nsvcd__d3 before = nsvcd__d3_sub(b->low, a->high);
  const nsvcd__d3 after = nsvcd__d3_sub(a->low, b->high);
  const nsvcd__d3 apart = nsvcd__d3_max(before, after);
  return apart.x > room || apart.y > room || apart.z > room;
}

// ---- a checker

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
  const size_t rows = movers * samples;
  c->joints = NSVCD__TAKE_ROWS(nsvcd_joint, scene->joint_count, base, &used);
  c->links = NSVCD__TAKE_ROWS(nsvcd__link, scene->joint_count, base, &used);
  c->at = NSVCD__TAKE_ROWS(nsvcd__links, 1, base, &used);
  c->next = NSVCD__TAKE_ROWS(nsvcd__links, 1, base, &used);
  c->members = NSVCD__TAKE_ROWS(nsvcd__member, parts, base, &used);
  c->movers = NSVCD__TAKE_ROWS(uint32_t, movers, base, &used);
  c->cones = NSVCD__TAKE_ROWS(nsvcd__kept_axis, scene->cone_count, base, &used);
  c->order = NSVCD__TAKE_ROWS(uint32_t, pairs, base, &used);
  c->left = NSVCD__TAKE_ROWS(uint32_t, pairs, base, &used);
  c->frames = NSVCD__TAKE_ROWS(nsvcd__dpose, rows, base, &used);
  c->bounds = NSVCD__TAKE_ROWS(nsvcd__bounds, rows, base, &used);
  c->deviations = NSVCD__TAKE_ROWS(double, rows, base, &used);
  for (size_t n = 0; n < 2; n++)
    c->local[n] = NSVCD__TAKE_ROWS(nsvcd_pose, samples, base, &used);
  c->cuts = NSVCD__TAKE_ROWS(double, 2 * scene->allowance_count, base, &used);
  c->query_size = nsvcd_sweep_workspace_size(NULL);
  c->query = nsvcd__take(base, &used, 1, c->query_size);
  *checker = (nsvcd_checker *)at;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene) {
  nsvcd_checker *unused;
  return nsvcd__scene_check(scene) ? 0 : nsvcd__checker_layout(scene, NULL, &unused);
}

static nsvcd__member nsvcd__member_of(const nsvcd_part *part) {
  const double scale = part->scale > 0 ? (double)part->scale : 1;
  const nsvcd_body_facts facts = nsvcd_body_describe(part->body);
  const nsvcd__d3 low = nsvcd__d3_load(facts.low);
  const nsvcd__d3 high = nsvcd__d3_load(facts.high);
  const nsvcd__d3 ones = {1, 1, 1};
  const nsvcd__d3 centre = nsvcd__d3_scale(nsvcd__d3_load(facts.centre), scale);
  const nsvcd__d3 half = nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5 * scale);
  nsvcd__member m;
  memset(&m, 0, sizeof m);
  m.frame = nsvcd__unit_dpose(&part->pose);
  m.centre = nsvcd__dpose_apply(&m.frame, centre);
  // spheres are computed in float
  m.radius = scale * (1.000001 * (double)facts.radius - (double)facts.convex_radius);
  m.extent = 1.000001 * scale * (double)facts.extent;
  m.middle = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5 * scale);
  // a rounded body goes beyond its triangles
  m.round = scale * (double)facts.convex_radius;
  m.half = nsvcd__d3_fma(m.round, ones, half);
  m.ball_error = scale * (double)facts.ball_error;
  m.balls = facts.balls;
  m.bounds = nsvcd__bounds_of(&m, &m.frame);
  return m;
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
  c->own = *scene;
  c->own.joints = c->joints;
  c->scene = scene;
  c->surfaces = 0;
  c->units = 0;
  c->stop = NULL;
  c->result = NSVCD_OK;
  for (size_t i = 0; i < scene->joint_count; i++) {
    const nsvcd_joint *joint = &scene->joints[i];
    c->joints[i] = nsvcd__narrowed(scene, i);
    if (joint->mimic) c->scene = &c->own;
    nsvcd__link *link = &c->links[i];
    link->origin = nsvcd__unit_dpose(&joint->origin);
    link->axis = nsvcd__d3_unit(nsvcd__d3_load(joint->axis), nsvcd__d3_of(0, 0, 1));
  }
  c->mover_count = 0;
  for (size_t n = 0; n < scene->part_count; n++) {
    c->members[n] = nsvcd__member_of(&scene->parts[n]);
    c->members[n].row = c->mover_count * (NSVCD__MOST_STEPS + 1);
    if (scene->parts[n].link) c->movers[c->mover_count++] = (uint32_t)n;
  }
  for (size_t n = 0; n < scene->cone_count; n++) {
    const nsvcd_cone *cone = &scene->cones[n];
    const nsvcd__d3 up = nsvcd__d3_of(0, 0, 1);
    const nsvcd__d3 axis = nsvcd__d3_unit(nsvcd__d3_load(cone->axis), up);
    c->cones[n].link = scene->parts[cone->part].link;
    c->cones[n].axis = nsvcd__dquat_rotate(c->members[cone->part].frame.rotation, axis);
    c->cones[n].direction = nsvcd__d3_unit(nsvcd__d3_load(cone->direction), up);
    c->cones[n].angle = cone->angle;
  }
  for (size_t k = 0; k < scene->pair_count; k++) c->order[k] = (uint32_t)k;
  *checker = c;
  return NSVCD_OK;
}
