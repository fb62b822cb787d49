// In: a task. Out: its answer, by proof, with contacts as points in the world.
#pragma once
#include "leave.h"
#include "long.h"
#include "normals.h"
#include "supports.h"
#include "../task/task.h"

#ifndef NSVCD_NO_PROOF
// A body's pose at time t in [0,1], in the world.
static nsvcd__dpose nsvcd__dpose_at(const nsvcd__motion *motion, const nsvcd__track *track,
                                    double t) {
  const double tick = t * (double)motion->ticks;
  const uint32_t k = nsvcd__pose_before(track, (uint32_t)tick);
  const uint32_t from = nsvcd__tick_of(track, k);
  const uint32_t length = nsvcd__tick_of(track, k + 1) - from;
  const nsvcd_pose *a = &track->poses[k];
  const nsvcd_pose *b = track->count > 1 ? a + 1 : a;
  const double fraction = (tick - (double)from) / (double)length;
  return nsvcd__dpose_between(a, b, nsvcd__track_pivot(track), fraction);
}

// From the fixed body's frame, in metres, to the world, at time t.
static nsvcd__dtransform nsvcd__world_at(const nsvcd__motion *motion, double t) {
  const nsvcd__dpose pose = nsvcd__dpose_at(motion, &motion->fixed, t);
  return nsvcd__dtransform_of(&pose);
}

// the most by which time.low and time.high of an answer, of floats, are farther apart than proven
#define NSVCD__TIME_ROUNDING 2.4e-7

// The length to which an answer is asked for, or the default, in the fixed body's units.
static double nsvcd__to_of(const nsvcd__task *task) {
  const nsvcd_question *q = task->question;
  const float moving = task->motion.scale * nsvcd__whole_radius(task->moving);
  const float fixed = nsvcd__whole_radius(task->fixed);
  const float usual = NSVCD_DEFAULT_TO * (moving < fixed ? moving : fixed);
  return q->to > 0 ? (double)q->to / (double)task->motion.unit : (double)usual;
}

// How far points of the moving body travel in an arc, at most.
static double nsvcd__travel_in(const nsvcd__proof *p, const nsvcd__arc *arc) {
  return arc->speed + arc->turn * arc->scale * (double)p->moving.body->extent;
}

// The fraction of the motion in which no point of the moving body travels farther than `to`, at
// most `fraction`; 0: that is not asked for. Of a short motion it is at most a quarter, so that a
// contact does not cost all of it, but no less than a safe pose backs off. It is less by what the
// two times of an answer are rounded by.
static double nsvcd__fraction_of(nsvcd__proof *p, double to, double fraction) {
  const nsvcd__motion *motion = p->arcs.motion;
  const double most = fraction > 0 ? fraction : 1;
  double fastest = 0;  // per tick
  for (uint32_t first = 0; to > 0 && first < motion->ticks;) {
    const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, first);
    fastest = fmax(fastest, nsvcd__travel_in(p, arc) / (double)arc->ticks);
    first += arc->ticks;
  }
  const double whole = fastest * (double)motion->ticks;
  const double least = fmin(to, fmax(0.25 * whole, NSVCD__EPSILONS * nsvcd__epsilon(p)));
  const double share = least < most * whole ? least / whole : most;
  return fmax(share - NSVCD__TIME_ROUNDING, 0.5 * share);
}

// Prepares the proof for a question whose motion has been prepared. Returns what is asked of all of
// the motion.
static nsvcd__goal nsvcd__proof_begin(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd_question *q = task->question;
  const double unit = (double)task->motion.unit;
  nsvcd__solver *w = query->solver;
  nsvcd__given *given = &w->p.given;
  nsvcd__goal goal;
  memset(given, 0, sizeof *given);
  memset(&goal, 0, sizeof goal);
  w->isa = query->isa;
  w->intervals = query->intervals;
  goal.motion = &query->task.motion;
  nsvcd__restart(w, goal.motion);
  w->p.moving = nsvcd__geometry_of(nsvcd__triangles_of(task->moving));
  w->p.fixed = nsvcd__geometry_of(nsvcd__triangles_of(task->fixed));
  given->lengths = task->motion.scale * w->p.moving.body->extent + w->p.fixed.body->extent;
  given->lengths += nsvcd__pivot_arms(&task->motion);
  given->tolerance = (double)q->tolerance / unit;
  const double moving_radius = (double)w->p.moving.counts->convex_radius * task->motion.ratio;
  given->radius = moving_radius + (double)w->p.fixed.counts->convex_radius;
  given->clearance = (double)q->clearance / unit + given->radius;
  goal.clearance = given->clearance;
  given->slop = (double)q->slop / unit;
  const int is_verdict = q->ask != NSVCD_ASK_DISTANCE;
  const size_t most = is_verdict ? NSVCD_DEFAULT_VERDICT_WORK : NSVCD_DEFAULT_WORK;
  given->work = goal.limit = goal.most = q->work ? q->work : most;
  given->reserve = (q->work ? q->work : NSVCD_DEFAULT_WORK) / NSVCD__AFTER_UNRESOLVED;
  given->grows = q->work == 0;
  given->surfaces = q->surfaces;
  given->tells = q->ask != NSVCD_ASK_HIT || given->slop > 0;
  given->stop = q->stop;
  given->user = q->user;
  w->p.ask_at = q->stop ? NSVCD__STOP_UNITS : SIZE_MAX;
  w->p.work = w->p.stopped_at = w->p.push.normal_count = 0;
  w->inside = w->in_open = 0;
  w->unclear = NSVCD__CLEAR;
  const double to = nsvcd__to_of(task);
  if (q->ask == NSVCD_ASK_DISTANCE) given->width = to;
  if (q->ask == NSVCD_ASK_FIRST) {
    const int by_time = q->to_time > 0 && !(q->to > 0);
    given->to = q->to > 0 ? to : 0;
    given->fraction = nsvcd__fraction_of(&w->p, by_time ? 0 : to, (double)q->to_time);
  }
  goal.end = NSVCD__NEVER;
  goal.high = HUGE_VAL;
  goal.fraction = given->fraction;
  goal.after_unresolved = goal.fraction > 0 ? NSVCD__AFTER_FIRST_UNRESOLVED : given->reserve;
  w->p.goal = goal;
  return goal;
}

// Writes the contact that a proof has found: when, where, and of what. If the bodies were swapped,
// the fixed one counts as pushed out, in the opposite direction.
static NSVCD__NOINLINE void nsvcd__write_contact(const nsvcd__query *query,
                                                 const nsvcd__pair_contact *found,
                                                 nsvcd_contact *out) {
  const nsvcd__proof *p = &query->solver->p;
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *motion = &task->motion;
  const int rests = motion->moving.count == 1 && !motion->fixed_moves;
  const double time = rests ? 0 : found->tick / (double)motion->ticks;
  const double unit = (double)motion->unit;
  const nsvcd__dtransform world = nsvcd__world_at(motion, time);
  const nsvcd__d3 push_out = nsvcd__d3_scale(nsvcd__d3_widen(motion->push_out), task->swapped);
  const double beyond = fmin((double)p->fixed.counts->convex_radius, found->distance);
  const nsvcd__d3 on = nsvcd__d3_fma(beyond, found->normal, found->point);
  const nsvcd__d3 seen = nsvcd__d3_scale(nsvcd__d3_sub(on, push_out), unit);
  const nsvcd__d3 point = nsvcd__d3_transform(&world, seen);
  const nsvcd__d3 normal = nsvcd__dmat3_apply(&world.rotation, found->normal);
  nsvcd__f3_store(nsvcd__f3_round(point), out->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), out->normal);
  out->gap = (float)(fmax(found->distance - p->given.radius, 0) * unit);
  // Rounded up: by then they have met.
  out->time = (float)time;
  if ((double)out->time < time) out->time = nextafterf(out->time, 1);
  out->triangle_a = found->moving_triangle;
  out->triangle_b = found->fixed_triangle;
  out->patch_a = found->moving_patch;
  out->patch_b = found->fixed_patch;
}

// The moving body takes the push-out; if both or none move, a does.
static int nsvcd__takes_push_out(const nsvcd__task *task) {
  return !task->swapped || !(task->motion.fixed_moves || task->motion.moving.count == 1);
}

// The poses of both bodies at time t, with one of them displaced by a push-out, which is in the
// fixed body's frame and units.
static NSVCD__NOINLINE void nsvcd__poses_at(const nsvcd__task *task, double t,
                                            nsvcd__d3 push_out, nsvcd_pose *moving,
                                            nsvcd_pose *fixed) {
  const nsvcd__motion *motion = &task->motion;
  const double unit = (double)motion->unit;
  const int moving_takes_it = nsvcd__takes_push_out(task);
  const nsvcd__dtransform world = nsvcd__world_at(motion, t);
  const nsvcd__d3 seen = nsvcd__dmat3_apply(&world.rotation, push_out);
  for (int n = 0; n < 2; n++) {
    const double by = n == moving_takes_it ? 0 : n ? -unit : unit;
    nsvcd__dpose pose = nsvcd__dpose_at(motion, n ? &motion->fixed : &motion->moving, t);
    pose.position = nsvcd__d3_add(pose.position, nsvcd__d3_scale(seen, by));
    *(n ? fixed : moving) = nsvcd__dpose_round(&pose);
  }
}

// How far the poses of an answer, in float, are off at time t, at most, in the fixed body's units:
// positions and quaternions are off by 6e-8 of their length.
static double nsvcd__pose_error(const nsvcd__proof *p, double t) {
  const nsvcd__motion *motion = p->arcs.motion;
  const nsvcd__d3 moving = nsvcd__dpose_at(motion, &motion->moving, t).position;
  const nsvcd__d3 fixed = nsvcd__dpose_at(motion, &motion->fixed, t).position;
  const double positions = nsvcd__d3_norm(moving) + nsvcd__d3_norm(fixed);
  return 1.3e-7 * (2 * positions / (double)motion->unit + (double)p->given.lengths);
}

// Sets the bodies down at time t, at which they are free of each other when pushed out as the
// motion is: to a little more than their depth at the start, or to a little before they are in
// contact. Returns the push-out left. It is proven to be free, and so is the way down to it.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__set_down(nsvcd__query *query, nsvcd__goal goal,
                                                 double t) {
  nsvcd__solver *w = query->solver;
  const nsvcd__task *task = &query->task;
  nsvcd__motion *whole = goal.motion;
  nsvcd__motion down = *whole;
  nsvcd_pose moving[2], fixed[2];
  const int takes_it = nsvcd__takes_push_out(task);
  const nsvcd__track moves = {moving, NULL, takes_it ? 2u : 1u, 0, 0, 1, NULL};
  const nsvcd__track rests = {fixed, NULL, takes_it ? 1u : 2u, 0, 0, 1, NULL};
  const nsvcd__d3 push_out = nsvcd__d3_widen(whole->push_out);
  // Nearer to each other than stored triangles are known, nothing would be separated.
  const double epsilons = 4 * nsvcd__epsilon(&w->p) + nsvcd__pose_error(&w->p, t);
  const double kept = fmax(NSVCD__SET_DOWN * w->p.push.slop, epsilons);
  const nsvcd__d3 least = nsvcd__push_out(&w->p.push, kept, 1);
  const nsvcd__d3 by = nsvcd__d3_sub(push_out, least);
  const double length = nsvcd__d3_norm(by);
  if (!(nsvcd__d3_dot(by, push_out) > 0) || !(length > kept)) return push_out;
  nsvcd__poses_at(task, t, push_out, &moving[0], &fixed[0]);
  nsvcd__poses_at(task, t, least, &moving[1], &fixed[1]);
  nsvcd__motion_set_tracks(&down, moves, rests);
  down.push_out = nsvcd__f3_of(0, 0, 0);
  goal.motion = &down;
  goal.fraction = kept / length;
  goal.limit = w->p.work + w->p.given.reserve;
  const nsvcd__search_result result = nsvcd__search_anew(w, &query->broad_phase, goal);
  nsvcd__arcs_begin(&w->p.arcs, whole);
  const double until = nsvcd__clear_until(w, &result) / (double)down.ticks;
  // All before an unresolved pair is proven, but a query from close to it might not prove it again.
  const double clear = result.unresolved < result.end ? until - 0.5 * goal.fraction : until;
  return nsvcd__d3_sub(push_out, nsvcd__d3_scale(by, fmin(fmax(clear, 0), 1)));
}

// The bodies at rest as they are at time t, with the fixed one's origin in the world's: so points
// in its frame are as exact as they can be.
static nsvcd__motion nsvcd__rest_at(const nsvcd__task *task, double t, nsvcd_pose *poses) {
  nsvcd__motion still = task->motion;
  const nsvcd__track tracks[2] = {{&poses[0], NULL, 1, 0, 0, 1, NULL},
                                  {&poses[1], NULL, 1, 0, 0, 1, NULL}};
  nsvcd__dpose moving = nsvcd__dpose_at(&still, &still.moving, t);
  nsvcd__dpose fixed = nsvcd__dpose_at(&still, &still.fixed, t);
  const nsvcd__dmat3 rotation = nsvcd__dtransform_of(&fixed).rotation;
  const nsvcd__d3 push_out = nsvcd__dmat3_apply(&rotation, nsvcd__d3_widen(still.push_out));
  const nsvcd__d3 offset = nsvcd__d3_sub(moving.position, fixed.position);
  moving.position = nsvcd__d3_add(offset, nsvcd__d3_scale(push_out, (double)still.unit));
  fixed.position = nsvcd__d3_of(0, 0, 0);
  poses[0] = nsvcd__dpose_round(&moving);
  poses[1] = nsvcd__dpose_round(&fixed);
  nsvcd__motion_set_tracks(&still, tracks[0], tracks[1]);
  still.push_out = nsvcd__f3_of(0, 0, 0);
  return still;
}

// The normals that a manifold may have: that of the contact found, and those of its faces that are
// not against it and along which the bodies do not part. Returns how many. *twist: how the bodies
// move; 0 at the start, where they only touch.
static NSVCD__NOINLINE int nsvcd__manifold_normals(nsvcd__proof *p,
                                                   const nsvcd__pair_contact *found,
                                                   nsvcd__twist *twist, nsvcd__d3 *normals) {
  nsvcd__approach now;
  int count = 1;
  nsvcd__approach_at(p, found, found->tick, &now);
  memset(twist, 0, sizeof *twist);
  if (found->tick > 0) *twist = now.twist;
  normals[0] = found->normal;
  const nsvcd__facing f = nsvcd__facing_of(p, found->normal, &now.pair, now.contact.moving);
  for (int k = 1; k >= 0; k--) {
    const nsvcd__d3 n = f.faces[k];
    const nsvcd__d3 all[2] = {found->normal, found->normal};
    int is_new = nsvcd__d3_dot(n, found->normal) > -0.1;
    is_new &= !nsvcd__is_left(twist, found->point, n, all);
    for (int i = 0; i < count; i++) is_new &= nsvcd__d3_dot(n, normals[i]) <= 0.9;
    if (is_new) normals[count++] = n;
  }
  return count;
}

// Writes the manifold of the contact found. If a body stands on something, that contact may be with
// a side that rises from it: so the normals of both triangles are tried too, and the manifold that
// spans the most is taken.
static NSVCD__NOINLINE void nsvcd__write_manifold(nsvcd__query *query, nsvcd__goal goal,
                                                  const nsvcd__pair_contact *found,
                                                  nsvcd_answer *answer) {
  nsvcd__solver *w = query->solver;
  const nsvcd__task *task = &query->task;
  const double epsilon = nsvcd__epsilon(&w->p);
  const double same = epsilon + 1e-5 * (double)w->p.given.lengths;
  const float radius = task->motion.scale * task->moving->radius;
  const double extent = (double)fminf(radius, task->fixed->radius);
  nsvcd__manifold *m = &w->p.of.kept.manifold;
  nsvcd__d3 normals[3];
  double widest = -1;
  nsvcd_pose poses[2];
  nsvcd__twist twist;
  int tries = nsvcd__manifold_normals(&w->p, found, &twist, normals);
  nsvcd__motion still = nsvcd__rest_at(task, (double)answer->nearest.time, poses);
  nsvcd__motion *whole = goal.motion;
  goal.motion = &still;
  goal.clearance = w->p.given.clearance + fmax(nsvcd__to_of(task), 4 * epsilon);
  goal.limit = w->p.work + w->p.given.reserve;
  (void)nsvcd__list_all_near(query, goal);
  for (int k = 0; k < tries; k++) {
    int chosen[NSVCD_MAX_CONTACTS];
    double area;
    const int count = nsvcd__supports_of(&w->p, normals[k], &twist, -2, same, chosen, &area);
    if (count == 0 || !(area > 1.001 * widest)) continue;
    widest = area;
    if (count > 2 && area > 0.1 * extent * extent) tries = 1;
    answer->contact_count = (size_t)count;
    for (int n = 0; n < count; n++) {
      nsvcd__pair_contact support = m->supports[chosen[n]];
      support.tick = found->tick;
      nsvcd__write_contact(query, &support, &answer->contacts[n]);
      // The last bit tells which body a corner is of.
      answer->contacts[n].id = m->numbers[chosen[n]] ^ (uint32_t)task->swapped;
    }
  }
  nsvcd__arcs_begin(&w->p.arcs, whole);
}

// Writes where the bodies may go, which are proven free until answer->time.low, and how deep they
// are in contact at the start. If one may be inside the other, no push-out helps, and they stay.
static NSVCD__NOINLINE void nsvcd__write_safe_pose(nsvcd__query *query, nsvcd__goal goal,
                                                   int starts_free, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const nsvcd__solver *w = query->solver;
  const double t = (double)answer->safe.time;
  nsvcd__d3 push_out = nsvcd__d3_widen(task->motion.push_out);
  const int is_pushed = nsvcd__d3_dot(push_out, push_out) > 0;
  const int may_go = is_pushed && !w->inside && !w->unclear;
  if (is_pushed && !w->inside) {
    const double depth = nsvcd__d3_norm(nsvcd__push_out(&w->p.push, 0, 1));
    answer->depth = (float)(depth * (double)task->motion.unit);
  } else if (!is_pushed && (answer->time.low > 0 || starts_free)) {
    answer->depth = 0;
  }
  if (may_go) push_out = nsvcd__set_down(query, goal, t);
  // nsvcd__answer_begin has set the poses at the ends, as the caller has them.
  if (may_go || (t > 0 && t < 1))
    nsvcd__poses_at(task, t, push_out, &answer->safe.a, &answer->safe.b);
}

// Writes until when the motion is proven free, and up to which time the bodies may go.
static void nsvcd__write_time(nsvcd__proof *p, double clear_until, nsvcd_answer *answer) {
  const nsvcd__motion *motion = p->arcs.motion;
  const double ticks = (double)motion->ticks;
  const double until = fmin(fmax(clear_until / ticks, 0), 1);
  const double late = (double)answer->time.high - until;
  answer->time.low = (float)(until * (1 - 1e-7));
  if (late > p->given.fraction + 0.5 * NSVCD__TIME_ROUNDING) answer->why = NSVCD_WHY_WORK;
  // Closer poses are proven free here, but a new query from there could not prove it again.
  double u;
  const nsvcd__arc *arc = nsvcd__arc_at(&p->arcs, nsvcd__arc_of(motion, until * ticks, &u));
  const double length = nsvcd__travel_in(p, arc) * ticks / (double)arc->ticks;
  const double epsilons = NSVCD__EPSILONS * nsvcd__epsilon(p) + nsvcd__pose_error(p, until);
  const double back = length > epsilons ? epsilons / length : p->given.fraction;
  answer->safe.time = (float)(fmax(0, until - back) * (1 - 1e-7));
}

// Writes the bracket of the least distance.
static void nsvcd__write_distance(const nsvcd__proof *p, nsvcd_verdict verdict,
                                  const nsvcd__bracket *bracket,
                                  const nsvcd__search_result *named, nsvcd_answer *answer) {
  const double unit = (double)p->arcs.motion->unit;
  const double radius = p->given.radius;
  const double off = nsvcd__off_meshes(p) + 1e-12 * (double)p->given.lengths;
  double low = bracket->low;
  double high = bracket->high;
  if (verdict == NSVCD_FREE) low = fmax(p->given.clearance, low);
  if (named) high = fmax(named->found.distance, radius) + off;
  answer->distance.low = (float)(fmax(low - radius, 0) * unit * (1 - 1e-6));
  answer->distance.high = (float)(fmax(high - radius, 0) * unit * (1 + 1e-6));
}

// Why not all is answered; `why` unless there is a better reason. Neither work nor finer triangles
// would tell what is in an open solid.
static nsvcd_why nsvcd__why_of(const nsvcd__solver *w, nsvcd_why why, int is_wide,
                               nsvcd_verdict verdict, const nsvcd__search_result *result) {
  const int is_too_near =
      result->unresolved < NSVCD__NEVER || w->unclear == NSVCD__CANNOT_TELL;
  if (is_wide || verdict == NSVCD_UNDECIDED) why = NSVCD_WHY_WORK;
  if (why && w->in_open) return NSVCD_WHY_OPEN;
  return why && !is_wide && is_too_near ? NSVCD_WHY_TOO_NEAR : why;
}

// Writes the push-out in the world, at the start.
static void nsvcd__write_push_out(const nsvcd__motion *motion, nsvcd_answer *answer) {
  const nsvcd__d3 push_out = nsvcd__d3_widen(motion->push_out);
  if (!(nsvcd__d3_dot(push_out, push_out) > 0)) return;
  const nsvcd__dtransform world = nsvcd__world_at(motion, 0);
  const nsvcd__d3 turned = nsvcd__dmat3_apply(&world.rotation, push_out);
  const nsvcd__d3 metres = nsvcd__d3_scale(turned, (double)motion->unit);
  nsvcd__f3_store(nsvcd__f3_round(metres), answer->push_out);
}

// Answers a question whose motion has been prepared.
static void nsvcd__answer_by_proof(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__solver *w = query->solver;
  const nsvcd__goal goal = nsvcd__proof_begin(query);
  const nsvcd__given *given = &w->p.given;
  nsvcd__bracket bracket = {0, HUGE_VAL, 0};
  nsvcd__search_result result;
  if (given->slop > 0) nsvcd__push_out_motion(w, search, goal);
  nsvcd__finding finding = nsvcd__prove(w, search, goal, &result);
  if (given->width > 0 && finding != NSVCD__FOUND_INSIDE) {
    bracket = nsvcd__measure(w, search, goal, finding, &result);
    // A distance decides what was left undecided, but says nothing of containment.
    const int meets = result.has_contact && result.found.distance <= given->clearance;
    const int is_beyond = bracket.low > 0 && bracket.low >= given->clearance;
    const int is_clear = is_beyond && !w->unclear && !w->inside;
    if (finding == NSVCD__FOUND_UNDECIDED && (meets || is_clear))
      finding = meets ? NSVCD__FOUND_CONTACT : NSVCD__FOUND_FREE;
  }

  const double until = nsvcd__clear_until(w, &result);

  // The answer names the triangles of a contact, or else of an unresolved pair.
  const int is_inside = finding == NSVCD__FOUND_INSIDE;
  const int is_contact = finding == NSVCD__FOUND_CONTACT;
  const int is_unresolved =
      finding == NSVCD__FOUND_UNDECIDED && result.unresolved < NSVCD__NEVER;
  const int names = (result.has_contact || is_unresolved) && !is_inside;
  const nsvcd_verdict verdict = finding == NSVCD__FOUND_FREE ? NSVCD_FREE
                                : is_inside || is_contact    ? NSVCD_HIT
                                                             : NSVCD_UNDECIDED;
  if (names) nsvcd__resolve_normal(&w->p, until, &result);
  nsvcd__answer_begin(task, verdict, answer);
  answer->inside = is_inside;
  if (names || is_inside) nsvcd__write_contact(query, &result.found, &answer->nearest);
  if (is_inside) answer->nearest.gap = HUGE_VALF;
  if (verdict == NSVCD_HIT) answer->time.high = answer->nearest.time;
  if (is_contact) answer->contacts[answer->contact_count++] = answer->nearest;
  if (given->fraction > 0 && verdict != NSVCD_FREE && !is_inside)
    nsvcd__write_time(&w->p, until, answer);
  nsvcd__write_distance(&w->p, verdict, &bracket, names ? &result : NULL, answer);
  if (is_inside) answer->distance.high = 0;
  // A contact, found or moved to where it is nearer, may have made the bracket narrow enough.
  const double high = names ? result.found.distance : bracket.high;
  const int is_wide = bracket.is_wide && high - bracket.low > given->width;
  answer->why = nsvcd__why_of(w, answer->why, is_wide, verdict, &result);
  nsvcd__write_push_out(&task->motion, answer);
  if (task->question->manifold && is_contact)
    nsvcd__write_manifold(query, goal, &result.found, answer);
  nsvcd__write_safe_pose(query, goal, result.starts_free, answer);
  answer->work = w->p.stopped_at ? w->p.stopped_at : w->p.work;
}
#endif  // NSVCD_NO_PROOF
