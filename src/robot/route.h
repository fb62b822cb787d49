// In: a start and goals. Out: a motion that is proven free, in the caller's memory.
#pragma once
#include "trees.h"

// defaults; tries: for each node
#define NSVCD__NODES 20000
#define NSVCD__TRIES 4
#define NSVCD__SHORTCUTS 20
#define NSVCD__SMOOTHINGS 200
// times as many of both where there are cones
#define NSVCD__CONE_TRIES 3
#define NSVCD__MOST_LOOKS 200000
// of a search by looks: looks of the first, twice as many after each that finds nothing; searches
#define NSVCD__FIRST_LOOKS 4000
#define NSVCD__LOOK_SEARCHES 16
// of the balls' errors, which margins are less by after each search that finds nothing
#define NSVCD__LOOK_EASE 0.34f
// of the path between its ends: how long a way of several edges in its place may be
#define NSVCD__SHORTER 0.95
// radians or metres: corners of a path that are no farther apart are one
#define NSVCD__SAME_CORNER 1e-9

// ---- memory

static nsvcd_result nsvcd__route_check(const nsvcd_checker *checker,
                                       const nsvcd_route_problem *problem,
                                       const nsvcd_route_options *options) {
  if (!checker || !problem || !problem->start || !problem->goals) return NSVCD_ERROR_ARGUMENT;
  const size_t most = NSVCD_MAX_NODES;
  if (problem->goal_count < 1 || problem->goal_count > most) return NSVCD_ERROR_COUNT;
  if (problem->guess ? problem->guess_count > most : problem->guess_count > 0)
    return NSVCD_ERROR_COUNT;
  if (options && (options->nodes > most || !(options->edge >= 0))) return NSVCD_ERROR_ROUTE;
  if (options && options->shortcuts > most && options->shortcuts != NSVCD_NONE)
    return NSVCD_ERROR_ROUTE;
  const size_t joints = checker->scene->joint_count;
  const double *rows[3] = {problem->start, problem->goals, problem->guess};
  const size_t counts[3] = {1, problem->goal_count, problem->guess_count};
  for (size_t n = 0; n < 3; n++) {
    if (!nsvcd__are_numbers(rows[n], counts[n] * joints)) return NSVCD_ERROR_VALUE;
    if (!nsvcd__follows(checker->scene, counts[n], rows[n])) return NSVCD_ERROR_MIMIC;
    for (size_t k = 0; k < counts[n] * joints && problem->held; k++) {
      const double off = rows[n][k] - problem->start[k % joints];
      if (checker->scene->joints[k % joints].mimic) continue;
      if (problem->held[k % joints] && (off > 0 || off < 0)) return NSVCD_ERROR_HELD;
    }
  }
  return NSVCD_OK;
}

static void nsvcd__trajectory_take(nsvcd__trajectory *t, char *base, uint64_t *used,
                                   size_t pieces, size_t joints) {
  t->points = NSVCD__TAKE_ROWS(double, (2 * pieces + 1) * joints, base, used);
  t->times = NSVCD__TAKE_ROWS(double, pieces + 1, base, used);
}

// Lays a router out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes; 0 if they are more than can be counted.
static size_t nsvcd__router_layout(const nsvcd_checker *checker,
                                   const nsvcd_route_problem *problem,
                                   const nsvcd_route_options *options, char *base,
                                   nsvcd__router **router) {
  nsvcd__router counted;
  uint64_t used = 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd__router));
  nsvcd__router *r = at ? (nsvcd__router *)at : &counted;
  memset(r, 0, sizeof *r);
  if (options) r->options = *options;
  nsvcd_route_options *o = &r->options;
  o->nodes = o->nodes ? o->nodes : NSVCD__NODES;
  o->tries = o->tries ? o->tries : NSVCD__TRIES * o->nodes;
  o->edge = o->edge > 0 ? o->edge : 1;
  const size_t more = checker->scene->cone_count ? NSVCD__CONE_TRIES : 1;
  if (!o->shortcuts) o->shortcuts = more * NSVCD__SHORTCUTS;
  if (!o->smoothings) o->smoothings = more * NSVCD__SMOOTHINGS;
  if (o->shortcuts == NSVCD_NONE) o->shortcuts = 0;
  if (o->smoothings == NSVCD_NONE) o->smoothings = 0;
  o->looks = o->looks ? o->looks : NSVCD__MOST_LOOKS;
  if (o->looks == NSVCD_NONE || !nsvcd__can_look(checker)) o->looks = 0;
  const size_t joints = checker->scene->joint_count;
  // the caller's configurations do not count as nodes
  const size_t nodes = o->nodes + problem->goal_count + problem->guess_count + 1;
  for (size_t k = 0; k < 2; k++) {
    nsvcd__rrt *t = &r->trees[k];
    t->joints = joints;
    t->points = NSVCD__TAKE_ROWS(double, (nodes * joints), base, &used);
    t->parents = NSVCD__TAKE_ROWS(uint32_t, nodes, base, &used);
    t->next = NSVCD__TAKE_ROWS(uint32_t, nodes, base, &used);
    t->marks = NSVCD__TAKE_ROWS(uint8_t, nodes, base, &used);
    t->cells = NSVCD__TAKE_ROWS(nsvcd__cell, 2 * nodes, base, &used);
  }
  r->goals = NSVCD__TAKE_ROWS(size_t, problem->goal_count, base, &used);
  // a shortcut from an edge to the next adds a corner, or those of a way in the cones
  const size_t most = checker->scene->cone_count ? NSVCD__MOST_WAY : 1;
  const size_t rows = 2 * nodes + most * o->shortcuts;
  r->path = (double *)nsvcd__take(base, &used, rows, joints * sizeof(double));
  r->way = NSVCD__TAKE_ROWS(double, (NSVCD__MOST_WAY * joints), base, &used);
  nsvcd__trajectory_take(&r->trajectory, base, &used, NSVCD__MOST_PIECES, joints);
  nsvcd__trajectory_take(&r->other, base, &used, NSVCD__MOST_PIECES, joints);
  nsvcd__trajectory_take(&r->blend, base, &used, NSVCD__BLEND_PIECES, joints);
  if (o->looks) nsvcd__looker_take(checker->scene, base, &used, &r->looker);
  *router = (nsvcd__router *)at;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_route_size(const nsvcd_checker *checker,
                                 const nsvcd_route_problem *problem,
                                 const nsvcd_route_options *options) {
  nsvcd__router *unused;
  if (nsvcd__route_check(checker, problem, options)) return 0;
  return nsvcd__router_layout(checker, problem, options, NULL, &unused);
}

// ---- shortcuts

// The point that is this far along the path. Returns the corner before it.
static size_t nsvcd__path_at(const nsvcd__router *r, double along, double *at) {
  size_t k = 0;
  double length;
  for (;; k++) {
    length = nsvcd__edge_length(r, nsvcd__corner_at(r, k), nsvcd__corner_at(r, k + 1));
    if (k + 2 >= r->corners || along <= length) break;
    along -= length;
  }
  const double *from = nsvcd__corner_at(r, k);
  const double *to = nsvcd__corner_at(r, k + 1);
  const double fraction = length > 0 ? nsvcd__min(along / length, 1) : 0;
  for (size_t j = 0; j < r->joints; j++) at[j] = from[j] + fraction * (to[j] - from[j]);
  return k;
}

// Replaces the path between two points drawn on it by an edge, again and again, where that is free.
static void nsvcd__shorten(nsvcd__router *r) {
  const size_t bytes = r->joints * sizeof(double);
  for (size_t n = 0; n < r->options.shortcuts && r->corners > 2 && !r->is_stopped; n++) {
    double at[2][NSVCD_MAX_JOINTS];
    double length = 0;
    for (size_t k = 0; k + 1 < r->corners; k++)
      length += nsvcd__edge_length(r, nsvcd__corner_at(r, k), nsvcd__corner_at(r, k + 1));
    const double a = length * nsvcd__random(&r->random);
    const double b = length * nsvcd__random(&r->random);
    const size_t first = nsvcd__path_at(r, nsvcd__min(a, b), at[0]);
    const size_t last = nsvcd__path_at(r, nsvcd__max(a, b), at[1]);
    // on one edge nothing is won, and the path would grow by corners
    if (first == last) continue;
    const double longest = NSVCD__SHORTER * fabs(b - a);
    const size_t count = nsvcd__way_between(r, at[0], at[1], longest, r->way);
    if (!count) continue;
    // corners first + 1 to last make way for these
    const size_t rest = r->corners - (last + 1);
    const size_t next = first + 1 + count;
    memmove(nsvcd__corner_at(r, next), nsvcd__corner_at(r, last + 1), rest * bytes);
    memcpy(nsvcd__corner_at(r, first + 1), r->way, count * bytes);
    r->corners = next + rest;
  }
}

// Drops corners that are nearly at the one before: of so short an edge rounding would say what its
// acceleration is. The timed motion is proven as a whole.
static void nsvcd__simplify_path(nsvcd__router *r) {
  const size_t bytes = r->joints * sizeof(double);
  const double least2 = NSVCD__SAME_CORNER * NSVCD__SAME_CORNER;
  const double *last = nsvcd__corner_at(r, r->corners - 1);
  size_t kept = 1;
  for (size_t k = 1; k < r->corners; k++) {
    const double *at = nsvcd__corner_at(r, k);
    if (nsvcd__distance2(nsvcd__corner_at(r, kept - 1), at, r->joints) < least2) continue;
    memmove(nsvcd__corner_at(r, kept++), at, bytes);
  }
  // the end stays where it is
  memmove(nsvcd__corner_at(r, kept - 1), last, bytes);
  r->corners = kept;
}

// ---- a route

NSVCDDEF const char *nsvcd_route_status_string(nsvcd_route_status status) {
  static const char texts[][48] = {"found", "no path found with so many nodes or tries",
                                   "stopped", "start not free", "no goal free"};
  const size_t count = sizeof texts / sizeof texts[0];
  return (size_t)status < count ? texts[status] : "not a status";
}

// Copies a configuration, clamped to the limits where only rounding has it out. Is it free? That is
// tried with the search's clearance, then with the caller's, each with the search's work, then with
// all; edges from there are proven with what was enough.
static int nsvcd__take_in(nsvcd__router *r, const double *at, double *out) {
  const nsvcd_joint_motion motion = {0, 0, out, NULL};
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double error = nsvcd__limit_error(joint);
    out[j] = at[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    if (at[j] < joint->low && at[j] >= joint->low - error) out[j] = joint->low;
    if (at[j] > joint->high && at[j] <= joint->high + error) out[j] = joint->high;
  }
  nsvcd__follow(r->scene, 1, out);
  const nsvcd_check_options was = r->check;
  for (size_t n = 0; n < 4; n++) {
    r->check = was;
    if (n % 2) r->check.clearance = r->options.clearance;
    if (n / 2) r->check.work = 0;
    if (nsvcd__ask_motion(r, &motion)) return 1;
    // no work makes that free
    const nsvcd_check_answer *found = &r->answer.check;
    if (found->joint != NSVCD_NONE || (n % 2 && found->verdict == NSVCD_HIT)) break;
  }
  r->check = was;
  return 0;
}

// Adds a root to a tree, and to the range of all roots.
static void nsvcd__plant_root(nsvcd__router *r, nsvcd__rrt *t, const double *at) {
  const int is_first = r->trees[0].count == 0;
  for (size_t j = 0; j < r->joints; j++) {
    r->low[j] = is_first ? at[j] : nsvcd__min(r->low[j], at[j]);
    r->high[j] = is_first ? at[j] : nsvcd__max(r->high[j], at[j]);
  }
  nsvcd__tree_add(t, at, t->count);
}

// Plants the roots of the trees. Sets the status where there are none.
static void nsvcd__plant(nsvcd__router *r) {
  const double full_turn = 6.283185307179586;
  double at[NSVCD_MAX_JOINTS];
  r->answer.status = NSVCD_ROUTE_START;
  if (!nsvcd__take_in(r, r->problem.start, at)) return;
  nsvcd__plant_root(r, &r->trees[0], at);
  for (size_t g = 0; g < r->problem.goal_count; g++) {
    if (!nsvcd__take_in(r, r->problem.goals + g * r->joints, at)) continue;
    // as near as whole turns bring it
    for (size_t j = 0; j < r->joints; j++) {
      const double turns = floor((at[j] - r->trees[0].points[j]) / full_turn + 0.5);
      if (r->scene->joints[j].kind == NSVCD_JOINT_CONTINUOUS) at[j] -= full_turn * turns;
    }
    nsvcd__follow(r->scene, 1, at);
    r->goals[r->trees[1].count] = g;
    nsvcd__plant_root(r, &r->trees[1], at);
  }
  r->answer.status = r->trees[1].count ? NSVCD_ROUTE_LIMIT : NSVCD_ROUTE_GOAL;
}

// Makes a motion of the path and proves all of it: smooth, else with a rest at each corner. What
// looks found is tried smooth only.
static void nsvcd__time_path(nsvcd__router *r) {
  nsvcd_route_answer *answer = &r->answer;
  const nsvcd__trajectory *t = &r->trajectory;
  const double *last = nsvcd__corner_at(r, r->corners - 1);
  // a search before this one may have ended at another goal
  answer->unhindered = 0;
  for (size_t j = 0; j < r->joints; j++) {
    const nsvcd_joint *joint = &r->scene->joints[j];
    const double time = nsvcd__blend_time(r->path[j], 0, last[j], 0, nsvcd__speed_of(joint),
                                          nsvcd__acceleration_of(joint));
    answer->unhindered = nsvcd__max(answer->unhindered, time);
  }
  nsvcd_check_options whole;
  memset(&whole, 0, sizeof whole);
  whole.clearance = r->options.clearance;
  whole.stop = r->check.stop;
  whole.user = r->check.user;
  int is_free = 0;
  for (int rests = 0; rests < 2 - r->is_looking && !is_free; rests++) {
    if (!nsvcd__trajectory_along(r)) return;
    if (!rests) nsvcd__smooth(r);
    nsvcd__follow(r->scene, 2 * t->motion.pieces + 1, t->points);
    // also when the caller has stopped the search: what it found by then is proven
    is_free = !r->result && nsvcd__prove_by(r, &t->motion, &whole);
  }
  if (!is_free) return;
  answer->status = NSVCD_ROUTE_FOUND;
  answer->motion = t->motion;
  answer->duration = nsvcd__trajectory_end(t);
  for (size_t p = 1; p < t->motion.pieces; p++)
    answer->stops += (size_t)nsvcd__rests_at(t, r->joints, p);
}

// Makes a motion of the path where the trees have met.
static void nsvcd__make_motion(nsvcd__router *r) {
  nsvcd__take_path(r);
  nsvcd__shorten(r);
  nsvcd__simplify_path(r);
  nsvcd__time_path(r);
}

// Seeks a path and makes a motion of it. Looks are believed until one is refuted: from then on
// paths are proven first.
static void nsvcd__find_motion(nsvcd__router *r) {
  const int is_looking = r->is_looking;
  int is_believed = 1;
  while (nsvcd__seek(r)) {
    if (!is_believed && !nsvcd__prove_path(r)) continue;
    nsvcd__make_motion(r);
    if (!is_looking || r->answer.status == NSVCD_ROUTE_FOUND) return;
    is_believed = 0;
    if (!nsvcd__prove_path(r)) continue;
    r->is_looking = 0;
    nsvcd__make_motion(r);
    r->is_looking = is_looking;
    return;
  }
}

// Takes the trees back to their roots.
static void nsvcd__replant(nsvcd__router *r) {
  const size_t roots[2] = {1, r->root_count};
  for (size_t k = 0; k < 2; k++) {
    nsvcd__rrt *t = &r->trees[k];
    t->count = t->cell_count = 0;
    for (size_t n = 0; n < roots[k]; n++) {
      double at[NSVCD_MAX_JOINTS];
      memcpy(at, nsvcd__node_at(t, n), r->joints * sizeof *at);
      nsvcd__tree_add(t, at, n);
    }
    r->idle[k] = 0;
  }
  r->turn = 0;
  r->random = r->options.seed;
}

// Searches by looks until a motion is proven. Where nothing is found, the next search looks longer,
// and less strictly.
static void nsvcd__search_by_looks(nsvcd__router *r) {
  nsvcd__looker *k = &r->looker;
  nsvcd__looker_begin(r->checker, &r->check, k);
  r->is_looking = 1;
  for (size_t n = 0; n < NSVCD__LOOK_SEARCHES && !r->is_stopped; n++) {
    const double ease = nsvcd__min(1, (double)NSVCD__LOOK_EASE * (double)n);
    const size_t most = nsvcd__spent(r) + ((size_t)NSVCD__FIRST_LOOKS << n);
    nsvcd__replant(r);
    nsvcd__set_margins(k, r->options.clearance, (float)ease);
    for (size_t side = 0; side < 2; side++)
      for (size_t i = 0; i < r->trees[side].count; i++)
        nsvcd__look_past(k, nsvcd__node_at(&r->trees[side], i));
    r->looks = most < r->options.looks ? most : r->options.looks;
    r->random += n;
    nsvcd__find_motion(r);
    if (r->answer.status == NSVCD_ROUTE_FOUND || nsvcd__spent(r) >= r->options.looks) break;
  }
  r->is_looking = 0;
  r->answer.looks = k->count;
}

NSVCDDEF nsvcd_result nsvcd_route(nsvcd_checker *checker, const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, void *memory,
                                  size_t size, nsvcd_route_answer *answer) {
  nsvcd__router *r;
  const nsvcd_result result = nsvcd__route_check(checker, problem, options);
  if (result) return result;
  if (!answer) return NSVCD_ERROR_ARGUMENT;
  if (options && (!nsvcd__is_finite(options->clearance) || options->clearance < 0))
    return NSVCD_ERROR_CLEARANCE;
  const size_t needed = nsvcd__router_layout(checker, problem, options, NULL, &r);
  if (!memory || !nsvcd__is_aligned(memory) || !needed || size < needed)
    return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__router_layout(checker, problem, options, (char *)memory, &r);
  r->checker = checker;
  r->scene = checker->scene;
  r->joints = checker->scene->joint_count;
  r->problem = *problem;
  r->random = r->options.seed;
  r->check.clearance = r->options.clearance + NSVCD__SPARE;
  r->check.finest = NSVCD__SEARCH_FINEST;
  r->check.work = NSVCD__SEARCH_WORK;
  r->check.stop = problem->abandon;
  r->check.user = problem->user;
  for (size_t j = 0; j < r->joints; j++)
    if (!r->scene->joints[j].mimic && !(problem->held && problem->held[j]))
      r->moving[r->moving_count++] = j;
  nsvcd__plant(r);
  r->root_count = r->trees[1].count;
  if (r->root_count > 0 && r->options.looks) nsvcd__search_by_looks(r);
  if (r->root_count > 0 && r->answer.status != NSVCD_ROUTE_FOUND && !r->is_stopped) {
    nsvcd__replant(r);
    nsvcd__find_motion(r);
  }
  if (r->result) return r->result;
  if (r->is_stopped && r->answer.status != NSVCD_ROUTE_FOUND)
    r->answer.status = NSVCD_ROUTE_STOPPED;
  r->answer.nodes = r->trees[0].count + r->trees[1].count;
  *answer = r->answer;
  return NSVCD_OK;
}
