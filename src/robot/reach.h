// In: a robot, a frame on one of its links, and where that is to be. Out: configurations that have
// it there.
//
// Levenberg-Marquardt, from many starts. What is made 0 is how far the tool is off its target: an
// offset, in lengths of the chain, and a rotation vector, both in the target's frame; and how far
// axes are out of their cones. What the target or a cone leaves free counts as 0.
#pragma once
#include "../interface/reaches.h"
#include "cholesky.h"
#include "configurations.h"

// defaults
#define NSVCD__REACH_TOLERANCE 1e-6
#define NSVCD__REACH_APART 0.1
#define NSVCD__REACH_STARTS 200
// the search ends when so many starts have led to known solutions since the last new one
#define NSVCD__REACH_REPEATS 24
// steps from a start
#define NSVCD__REACH_STEPS 100
// the damping at first, of the squared error, up to 1; by what it changes from step to step; and
// the least, of the squares of the Jacobian
#define NSVCD__REACH_DAMPING 0.1
#define NSVCD__REACH_HARDER 8
#define NSVCD__REACH_EASIER 0.25
#define NSVCD__REACH_FLOOR 1e-13
// a start is given up after so many steps that each lessen the squared error by less than this
#define NSVCD__REACH_STALLS 6
#define NSVCD__REACH_GAIN 0.01
// the share of a cone's angle that is aimed at
#define NSVCD__REACH_CONE 0.999

// How far the tool is off its target: what is made 0 (three of the offset, three of the rotation,
// one of cones), and half of its square; metres and radians.
typedef struct nsvcd__miss {
  double residuals[NSVCD__MOST_ROWS];
  double cost, position, angle;
  // are all axes in their cones?
  int is_in;
} nsvcd__miss;

typedef struct nsvcd__reacher {
  nsvcd_checker *checker;
  const nsvcd_scene *scene;
  size_t joints;
  nsvcd_reach_problem problem;
  nsvcd_reach_options options;
  nsvcd__dpose tool, target;
  nsvcd__d3 free_axis;
  int has_free_axis;
  // the start, within the limits
  double start[NSVCD_MAX_JOINTS];
  // joints that move the tool against the target, the lower first: on the way to the tool, 1, or to
  // the target's link, -1; and leaders of such joints that are on neither, 0
  size_t chain[NSVCD_MAX_JOINTS];
  double sides[NSVCD_MAX_JOINTS];
  // of a step of each: radians, or lengths of the chain
  double units[NSVCD_MAX_JOINTS];
  size_t count;
  // metres: the lengths along the chain; and how far joints slide from the start when drawn
  double length, slide;
  uint64_t random;
  // where the links of the chain are, seen from the link where it forks; and the tool, seen from
  // the target
  nsvcd__links at;
  nsvcd__dpose there;
  nsvcd__miss miss;
  // the least cost of what does not reach the target
  double least;
  // starts that led to known solutions since the last new one
  size_t repeats;
  // of the Jacobian: one fewer where there are no cones
  size_t rows;
  // (joints of the chain): of the residuals; (F): of the last one
  double jacobian[NSVCD_MAX_JOINTS][NSVCD__MOST_ROWS], slope[NSVCD_MAX_JOINTS];
} nsvcd__reacher;

// ---- how far the tool is off

// Places the chain, and says how far off the tool is.
static void nsvcd__reach_place(nsvcd__reacher *r, const double *q) {
  const nsvcd_reach_problem *p = &r->problem;
  nsvcd__links *at = &r->at;
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    if (!(fabs(r->sides[n]) > 0)) continue;
    const nsvcd__dpose link = nsvcd__joint_frame(r->checker, j, q[j]);
    at->frames[j + 1] = nsvcd__dpose_mul(&at->frames[r->scene->joints[j].parent], &link);
    at->axes[j] = nsvcd__dquat_rotate(at->frames[j + 1].rotation, r->checker->links[j].axis);
  }
  const nsvcd__dpose tool = nsvcd__dpose_mul(&at->frames[p->link], &r->tool);
  const nsvcd__dpose target = nsvcd__dpose_mul(&at->frames[p->target_link], &r->target);
  r->there = nsvcd__dpose_inverse_mul(&target, &tool);
  const nsvcd__dquat unit = nsvcd__dquat_unit(r->there.rotation);
  nsvcd__d3 turn = nsvcd__dquat_axis(unit);
  if (r->has_free_axis) {
    turn = nsvcd__turn_between(r->free_axis, nsvcd__dquat_rotate(unit, r->free_axis));
  } else {
    const double sine = nsvcd__d3_norm(turn);
    const double angle = 2 * nsvcd__atan2(sine, fabs(unit.w));
    turn = nsvcd__d3_scale(turn, (unit.w < 0 ? -1 : 1) * (sine > 0 ? angle / sine : 2));
  }
  nsvcd__d3 off = {0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    const double x = nsvcd__d3_axis(r->there.position, k);
    const double half = (double)p->half[k];
    nsvcd__d3_set_axis(&off, k, x - nsvcd__max(-half, nsvcd__min(half, x)));
    r->miss.residuals[k] = nsvcd__d3_axis(off, k) / r->length;
    r->miss.residuals[3 + k] = nsvcd__d3_axis(turn, k);
  }
  r->miss.position = nsvcd__d3_norm(off);
  r->miss.angle = nsvcd__d3_norm(turn);
  r->miss.residuals[6] =
      nsvcd__cones_excess(r->checker, q, NSVCD__REACH_CONE, r->slope, &r->miss.is_in);
  r->miss.cost = 0;
  for (size_t k = 0; k < NSVCD__MOST_ROWS; k++)
    r->miss.cost += 0.5 * r->miss.residuals[k] * r->miss.residuals[k];
}

static int nsvcd__is_reached(const nsvcd__reacher *r) {
  return r->miss.position <= r->options.position_tolerance &&
         r->miss.angle <= r->options.angle_tolerance && r->miss.is_in;
}

// Adds what the joints that mimic one do to how the residuals change with it. All leaders are in
// the chain.
static void nsvcd__reach_add_driven(nsvcd__reacher *r) {
  for (size_t n = 0; n < r->count; n++) {
    const size_t driver = nsvcd__driver(r->scene, r->chain[n]);
    for (size_t i = 0; i < r->count && driver != r->chain[n]; i++) {
      const double rate = nsvcd__rate(r->scene, r->chain[n]) * r->units[i] / r->units[n];
      for (size_t k = 0; k < 6 && r->chain[i] == driver; k++)
        r->jacobian[i][k] += rate * r->jacobian[n][k];
    }
  }
}

// How the residuals change with each joint, which slides by lengths of the chain. Of a rotation
// vector that is exact as far as its own direction goes, which makes the gradient exact.
static void nsvcd__reach_differentiate(nsvcd__reacher *r) {
  const nsvcd_reach_problem *p = &r->problem;
  const nsvcd__dpose tool = nsvcd__dpose_mul(&r->at.frames[p->link], &r->tool);
  const nsvcd__dpose target = nsvcd__dpose_mul(&r->at.frames[p->target_link], &r->target);
  const nsvcd__dmat3 axes = nsvcd__dmat3_of(nsvcd__dquat_unit(target.rotation));
  const nsvcd__d3 spin = nsvcd__dquat_rotate(tool.rotation, r->free_axis);
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    const nsvcd__d3 axis = nsvcd__d3_scale(r->at.axes[j], r->sides[n]);
    const nsvcd__d3 arm = nsvcd__d3_sub(tool.position, r->at.frames[j + 1].position);
    nsvcd__d3 moves = nsvcd__d3_scale(nsvcd__d3_cross(axis, arm), 1 / r->length);
    nsvcd__d3 turns = axis;
    if (nsvcd__slides(r->checker, j)) {
      moves = axis;
      turns = nsvcd__d3_of(0, 0, 0);
    }
    if (r->has_free_axis) turns = nsvcd__d3_fma(-nsvcd__d3_dot(turns, spin), spin, turns);
    moves = nsvcd__dmat3_apply_transpose(&axes, moves);
    turns = nsvcd__dmat3_apply_transpose(&axes, turns);
    for (size_t k = 0; k < 3; k++) {
      const int is_free = fabs(nsvcd__d3_axis(r->there.position, k)) < (double)p->half[k];
      r->jacobian[n][k] = is_free ? 0 : nsvcd__d3_axis(moves, k);
      r->jacobian[n][3 + k] = nsvcd__d3_axis(turns, k);
    }
    r->jacobian[n][6] = r->units[n] * r->slope[j];
  }
  nsvcd__reach_add_driven(r);
}

// ---- a step

// Does the caller hold a joint of the chain, or another joint drive it?
static int nsvcd__reach_holds(const nsvcd__reacher *r, size_t n) {
  const size_t j = r->chain[n];
  return r->scene->joints[j].mimic || (r->problem.held && r->problem.held[j]);
}

// A damped step from q that keeps the limits: J^T y, where (J J^T + damping) y is minus the
// residuals. A joint that would leave its limits goes to the limit and is held there, and the
// others step anew. *expected: by how much the cost falls, if it is as the Jacobian says.
static void nsvcd__reach_step(const nsvcd__reacher *r, const double *q, double damping,
                              double *out, double *expected) {
  double step[NSVCD_MAX_JOINTS];
  int is_held[NSVCD_MAX_JOINTS];
  double left[NSVCD__MOST_ROWS], y[NSVCD__MOST_ROWS];
  const size_t rows = r->rows;
  size_t held = 0;
  for (size_t n = 0; n < r->count; n++) {
    is_held[n] = nsvcd__reach_holds(r, n);
    step[n] = 0;
  }
  for (size_t k = 0; k < rows; k++) left[k] = -r->miss.residuals[k];
  for (;;) {
    const size_t before = held;
    double m[NSVCD__MOST_ROWS][NSVCD__MOST_ROWS] = {{0}};
    double squares = 0;
    for (size_t n = 0; n < r->count; n++) {
      const double *column = r->jacobian[n];
      for (size_t i = 0; i < rows && !is_held[n]; i++) {
        for (size_t k = 0; k <= i; k++) m[i][k] += column[i] * column[k];
      }
    }
    for (size_t i = 0; i < rows; i++) squares += m[i][i];
    for (size_t i = 0; i < rows; i++)
      m[i][i] += damping + NSVCD__REACH_FLOOR * nsvcd__max(squares, 1e-30);
    nsvcd__solve_rows(m, left, rows, y);
    for (size_t n = 0; n < r->count; n++) {
      const double *column = r->jacobian[n];
      double sum = 0;
      if (is_held[n]) continue;
      for (size_t k = 0; k < rows; k++) sum += column[k] * y[k];
      step[n] = sum;
    }
    for (size_t n = 0; n < r->count; n++) {
      const size_t j = r->chain[n];
      const nsvcd_joint *joint = &r->scene->joints[j];
      const double up = (nsvcd__high_of(joint) - q[j]) / r->units[n];
      const double down = (nsvcd__low_of(joint) - q[j]) / r->units[n];
      if (is_held[n] || (step[n] <= up && step[n] >= down)) continue;
      step[n] = step[n] > up ? up : down;
      is_held[n] = 1;
      held++;
      for (size_t k = 0; k < rows; k++) left[k] -= r->jacobian[n][k] * step[n];
    }
    if (held == before) break;
  }
  memcpy(out, q, r->joints * sizeof *out);
  *expected = r->miss.cost;
  for (size_t k = 0; k < rows; k++) {
    double residual = r->miss.residuals[k];
    for (size_t n = 0; n < r->count; n++) residual += r->jacobian[n][k] * step[n];
    *expected -= 0.5 * residual * residual;
  }
  for (size_t n = 0; n < r->count; n++) out[r->chain[n]] += r->units[n] * step[n];
  nsvcd__follow(r->scene, 1, out);
}

// Goes from q to where the tool is at its target, or as near to that as it comes, until so many
// steps in a row win little. Returns 1 if it is there. r->miss: of that place.
static int nsvcd__descend(nsvcd__reacher *r, size_t most_stalls, double *q) {
  double damping = NSVCD__REACH_DAMPING;
  size_t stalls = 0;
  int is_reached = 0;
  nsvcd__reach_place(r, q);
  nsvcd__reach_differentiate(r);
  for (size_t n = 0; n < NSVCD__REACH_STEPS && stalls < most_stalls; n++) {
    double next[NSVCD_MAX_JOINTS];
    double expected;
    const nsvcd__miss was = r->miss;
    is_reached = nsvcd__is_reached(r);
    nsvcd__reach_step(r, q, damping * nsvcd__min(was.cost, 1), next, &expected);
    nsvcd__reach_place(r, next);
    const double gain = was.cost - r->miss.cost;
    if (gain > 0 && (!is_reached || nsvcd__is_reached(r))) {
      memcpy(q, next, r->joints * sizeof *q);
      nsvcd__reach_differentiate(r);
      if (gain > 0.5 * expected) damping *= NSVCD__REACH_EASIER;
    } else {
      r->miss = was;
      damping *= NSVCD__REACH_HARDER;
    }
    // one step more makes what is found from other starts the same
    if (is_reached) return 1;
    stalls = gain > NSVCD__REACH_GAIN * was.cost ? 0 : stalls + 1;
  }
  return nsvcd__is_reached(r);
}

// ---- starts and solutions

// Where a search begins that is not the start.
static void nsvcd__reach_draw(nsvcd__reacher *r, double *q) {
  memcpy(q, r->start, r->joints * sizeof *q);
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    const nsvcd_joint *joint = &r->scene->joints[j];
    if (nsvcd__reach_holds(r, n)) continue;
    const int is_bounded = joint->kind == NSVCD_JOINT_REVOLUTE;
    const double most = nsvcd__slides(r->checker, j) ? r->slide : 3.141592653589793;
    const double from = is_bounded ? joint->low : q[j] - most;
    const double to = is_bounded ? joint->high : q[j] + most;
    const double low = nsvcd__max(nsvcd__low_of(joint), from);
    const double high = nsvcd__min(nsvcd__high_of(joint), to);
    q[j] = low + (high - low) * nsvcd__random(&r->random);
  }
  nsvcd__follow(r->scene, 1, q);
}

// Takes joints that turn as near to the start as whole turns bring them within their limits. A step
// to a limit may be off it by a rounding.
static void nsvcd__reach_unwind(const nsvcd__reacher *r, double *q) {
  const double full_turn = 6.283185307179586;
  for (size_t n = 0; n < r->count; n++) {
    const size_t j = r->chain[n];
    const nsvcd_joint *joint = &r->scene->joints[j];
    double turns = floor((q[j] - r->start[j]) / full_turn + 0.5);
    if (nsvcd__slides(r->checker, j) || nsvcd__leads(r->scene, j)) continue;
    const double to = q[j] - full_turn * turns;
    // the next one is between the start and q
    if (to < nsvcd__low_of(joint) || to > nsvcd__high_of(joint)) turns -= turns > 0 ? 1 : -1;
    q[j] -= full_turn * turns;
  }
  nsvcd__clamp_to_limits(r->scene, q);
}

static void nsvcd__reach_note(const nsvcd__reacher *r, const double *q,
                              nsvcd_reach_answer *answer) {
  memcpy(answer->best, q, r->joints * sizeof *q);
  answer->position_error = r->miss.position;
  answer->angle_error = r->miss.angle;
}

// Is a configuration proven free, if it has to be? An error is in c->result.
static int nsvcd__reach_is_free(nsvcd__reacher *r, const double *q,
                                nsvcd_check_answer *found) {
  const nsvcd_joint_motion still = {0, 0, q, NULL};
  const nsvcd_check_options options = {r->options.clearance, 0, 0, r->problem.stop,
                                       r->problem.user,      0};
  if (r->options.may_touch) return 1;
  return !nsvcd_check(r->checker, &still, &options, found) && nsvcd__proves_free(found);
}

// Takes a configuration that has the tool at the target among the solutions, unless one beside it
// is as near to the start.
static void nsvcd__reach_take(nsvcd__reacher *r, const double *q, double *out,
                              nsvcd_reach_answer *answer) {
  const size_t joints = r->joints;
  const double apart2 = r->options.apart * r->options.apart;
  const double distance2 = nsvcd__distance2(q, r->start, joints);
  nsvcd_check_answer found;
  size_t kept = 0;
  memset(&found, 0, sizeof found);
  for (size_t n = 0; n < answer->solutions; n++) {
    const double *row = out + n * joints;
    const int is_beside = nsvcd__distance2(row, q, joints) < apart2;
    if (!is_beside || nsvcd__distance2(row, r->start, joints) > distance2) continue;
    r->repeats++;
    return;
  }
  if (!nsvcd__reach_is_free(r, q, &found)) {
    const double best2 = nsvcd__distance2(answer->best, r->start, joints);
    const int is_better = !answer->touching || distance2 < best2;
    answer->touching++;
    if (answer->solutions > 0 || !is_better) return;
    nsvcd__reach_note(r, q, answer);
    answer->check = found;
    return;
  }
  for (size_t n = 0; n < answer->solutions; n++) {
    const double *row = out + n * joints;
    if (nsvcd__distance2(row, q, joints) < apart2) continue;
    memmove(out + kept++ * joints, row, joints * sizeof *q);
  }
  size_t at = kept;
  while (at > 0 && nsvcd__distance2(out + (at - 1) * joints, r->start, joints) > distance2)
    at--;
  memmove(out + (at + 1) * joints, out + at * joints, (kept - at) * joints * sizeof *q);
  memcpy(out + at * joints, q, joints * sizeof *q);
  if (kept == answer->solutions) r->repeats = 0;
  answer->solutions = kept + 1;
  if (at == 0) nsvcd__reach_note(r, q, answer);
}

// Goes from q to the target. What that leads to is taken, or noted.
static void nsvcd__reach_from(nsvcd__reacher *r, size_t most_stalls, double *q, double *out,
                              nsvcd_reach_answer *answer) {
  int is_reached = nsvcd__descend(r, most_stalls, q);
  nsvcd__reach_unwind(r, q);
  nsvcd__reach_place(r, q);
  is_reached = is_reached && nsvcd__is_reached(r);
  answer->reached += (size_t)is_reached;
  if (is_reached) {
    nsvcd__reach_take(r, q, out, answer);
  } else if (!answer->reached && r->miss.cost < r->least) {
    r->least = r->miss.cost;
    nsvcd__reach_note(r, q, answer);
  }
}

// ---- the public function

static nsvcd_result nsvcd__reach_check(const nsvcd_checker *c, const nsvcd_reach_problem *p,
                                       const nsvcd_reach_options *o) {
  nsvcd_result result = nsvcd__check_joints(c, p->start);
  if (result) return result;
  if (p->link > c->scene->joint_count || p->target_link > c->scene->joint_count)
    return NSVCD_ERROR_LINK;
  result = nsvcd__poses_check(&p->tool, 1);
  if (!result) result = nsvcd__poses_check(&p->target, 1);
  if (result) return result;
  for (size_t k = 0; k < 3; k++)
    if (!nsvcd__is_length(p->half[k])) return NSVCD_ERROR_RADIUS;
  if (!nsvcd__in_range(p->free_axis, 3, 1e15f)) return NSVCD_ERROR_AXIS;
  const double tolerances[2] = {o->position_tolerance, o->angle_tolerance};
  if (!nsvcd__are_numbers(tolerances, 2) || tolerances[0] < 0 || tolerances[1] < 0)
    return NSVCD_ERROR_TOLERANCE;
  if (!nsvcd__are_numbers(&o->apart, 1) || o->apart < 0) return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__in_range(&o->clearance, 1, 0.5f * NSVCD_MAX_COORDINATE) || o->clearance < 0)
    return NSVCD_ERROR_CLEARANCE;
  return NSVCD_OK;
}

// Finds the joints between the tool and the target, and how long the chain is. Returns 0 if there
// are none.
static size_t nsvcd__reach_chain(nsvcd__reacher *r) {
  const nsvcd_joint *joints = r->scene->joints;
  const nsvcd_reach_problem *p = &r->problem;
  const nsvcd__dpose origin = {{0, 0, 0, 1}, {0, 0, 0}};
  double sides[NSVCD_MAX_JOINTS] = {0};
  int moves[NSVCD_MAX_JOINTS] = {0};
  uint32_t fork = p->link;
  for (uint32_t l = p->link; l; l = joints[l - 1].parent) sides[l - 1] += 1;
  for (uint32_t l = p->target_link; l; l = joints[l - 1].parent) sides[l - 1] -= 1;
  while (fork && sides[fork - 1] > 0) fork = joints[fork - 1].parent;
  r->at.frames[fork] = origin;
  if (p->link != fork) r->length += nsvcd__d3_norm(r->tool.position);
  if (p->target_link != fork) r->length += nsvcd__d3_norm(r->target.position);
  for (size_t j = 0; j < r->joints; j++)
    moves[nsvcd__driver(r->scene, j)] |= fabs(sides[j]) > 0;
  for (size_t j = 0; j < r->joints; j++) {
    const int is_between = fabs(sides[j]) > 0;
    if (!is_between && !moves[j]) continue;
    if (is_between && joints[j].parent != fork)
      r->length += nsvcd__d3_norm(r->checker->links[j].origin.position);
    r->sides[r->count] = sides[j];
    r->chain[r->count++] = j;
  }
  // of a chain without lengths, how far it has to go
  const double length = r->length;
  r->length = 1;
  nsvcd__reach_place(r, r->start);
  r->slide = length + r->miss.position;
  r->length = length > 0 ? length : r->slide > 0 ? r->slide : 1;
  for (size_t n = 0; n < r->count; n++)
    r->units[n] = nsvcd__slides(r->checker, r->chain[n]) ? r->length : 1;
  return r->count;
}

static void nsvcd__reach_begin(nsvcd__reacher *r, nsvcd_checker *c,
                               const nsvcd_reach_problem *problem,
                               const nsvcd_reach_options *options) {
  const nsvcd__d3 none = {0, 0, 0};
  nsvcd_reach_options *o = &r->options;
  memset(r, 0, sizeof *r);
  r->checker = c;
  r->scene = c->scene;
  r->joints = c->scene->joint_count;
  r->problem = *problem;
  *o = *options;
  if (!(o->position_tolerance > 0)) o->position_tolerance = NSVCD__REACH_TOLERANCE;
  if (!(o->angle_tolerance > 0)) o->angle_tolerance = NSVCD__REACH_TOLERANCE;
  if (!(o->apart > 0)) o->apart = NSVCD__REACH_APART;
  if (!o->starts) o->starts = NSVCD__REACH_STARTS;
  r->random = o->seed;
  r->rows = NSVCD__MOST_ROWS - (r->scene->cone_count == 0);
  r->tool = nsvcd__unit_dpose(&problem->tool);
  r->target = nsvcd__unit_dpose(&problem->target);
  r->free_axis = nsvcd__d3_unit(nsvcd__d3_load(problem->free_axis), none);
  r->has_free_axis = nsvcd__d3_norm(r->free_axis) > 0;
  memcpy(r->start, problem->start, r->joints * sizeof *r->start);
  nsvcd__clamp_to_limits(r->scene, r->start);
}

NSVCDDEF nsvcd_result nsvcd_reach(nsvcd_checker *checker, const nsvcd_reach_problem *problem,
                                  const nsvcd_reach_options *options, double *out,
                                  size_t capacity, nsvcd_reach_answer *answer) {
  nsvcd__reacher r;
  nsvcd_reach_options defaults;
  nsvcd_reach_answer found;
  if (!checker || !problem || !out || !answer) return NSVCD_ERROR_ARGUMENT;
  if (!capacity) return NSVCD_ERROR_COUNT;
  memset(&defaults, 0, sizeof defaults);
  memset(&found, 0, sizeof found);
  const nsvcd_result result =
      nsvcd__reach_check(checker, problem, options ? options : &defaults);
  if (result) return result;
  nsvcd__reach_begin(&r, checker, problem, options ? options : &defaults);
  if (!nsvcd__reach_chain(&r)) return NSVCD_ERROR_LINK;
  nsvcd__reach_place(&r, r.start);
  nsvcd__reach_note(&r, r.start, &found);
  r.least = r.miss.cost;
  checker->result = NSVCD_OK;
  double q[NSVCD_MAX_JOINTS];
  int is_stopped = 0;
  while (found.starts < r.options.starts && found.solutions < capacity &&
         r.repeats < NSVCD__REACH_REPEATS && !checker->result) {
    is_stopped = problem->stop && problem->stop(problem->user);
    if (is_stopped) break;
    memcpy(q, r.start, sizeof q);
    if (found.starts++ > 0) nsvcd__reach_draw(&r, q);
    nsvcd__reach_from(&r, NSVCD__REACH_STALLS, q, out, &found);
  }
  // by how much it is missed is to be told well
  memcpy(q, found.best, sizeof q);
  if (!found.reached && !is_stopped) nsvcd__reach_from(&r, NSVCD__REACH_STEPS, q, out, &found);
  if (!checker->result) *answer = found;
  return checker->result;
}
