// In: a task. Out: its answer, by proof, with the contact as places in the world.
#pragma once
#include "../proof/leave.h"
#include "../proof/long.h"
#include "../proof/normals.h"
#include "task.h"

#ifndef NSVCD_NO_PROOF
// Where a body is at time t in [0,1], in the world.
static nsvcd__dquat nsvcd__turn_at(const nsvcd__motion *motion, const nsvcd__track *track,
                                   double t, nsvcd__d3 *position) {
  nsvcd__slerp slerp;
  nsvcd__d3 ends[2];
  double u;
  const uint32_t first = nsvcd__arc_of(motion, t * (double)motion->ticks, &u);
  nsvcd__slerp_init(track, first, nsvcd__next_keyframe(motion, first) - first, &slerp, ends);
  *position = nsvcd__d3_mix(ends[0], ends[1], u);
  return nsvcd__slerp_at(&slerp, u);
}

// From the fixed body's frame and units to the world, at time t.
typedef struct nsvcd__to_world {
  nsvcd__dmat3 rotation;
  nsvcd__d3 position;
  double unit;
} nsvcd__to_world;

static nsvcd__to_world nsvcd__to_world_at(const nsvcd__motion *motion, double t) {
  nsvcd__to_world out;
  const nsvcd__dquat turn = nsvcd__turn_at(motion, &motion->fixed, t, &out.position);
  out.rotation = nsvcd__dmat3_of(turn);
  out.unit = (double)motion->unit;
  return out;
}

// To how many of the fixed body's units an answer is asked for, or is by default.
static double nsvcd__to_of(const nsvcd__task *task) {
  const nsvcd_question *q = task->question;
  const float moving = task->motion.scale * nsvcd__whole_radius(task->moving);
  const float fixed = nsvcd__whole_radius(task->fixed);
  const float usual = NSVCD_DEFAULT_TO * (moving < fixed ? moving : fixed);
  return q->to > 0 ? (double)q->to / (double)task->motion.unit : (double)usual;
}

// How far points of the moving body go in an arc, at most.
static double nsvcd__way_in(const nsvcd__proof *p, const nsvcd__arc *arc) {
  return arc->speed + arc->turn * arc->scale * (double)p->moving.body->extent;
}

// The fraction of the motion in which no point of the moving body travels farther than `to`, no
// longer than `fraction`, where these are asked for. Of a short motion it is at most a quarter, but
// no less than a safe pose backs off, so that a contact does not cost all of it.
static double nsvcd__fraction_of(nsvcd__proof *p, double to, double fraction) {
  const nsvcd__motion *motion = p->ask.motion;
  const double most = fraction > 0 ? fraction : 1;
  double fastest = 0;  // per tick
  // that of the question before
  p->arc.ticks = 0;
  for (uint32_t first = 0; to > 0 && first < motion->ticks;) {
    const nsvcd__arc *arc = nsvcd__arc_at(p, first);
    fastest = fmax(fastest, nsvcd__way_in(p, arc) / (double)arc->ticks);
    first += arc->ticks;
  }
  const double whole = fastest * (double)motion->ticks;
  const double least = fmin(to, fmax(0.25 * whole, NSVCD__EPSILONS * nsvcd__epsilon(p)));
  return least < most * whole ? least / whole : most;
}

// Makes the proof ready for a question whose motion has been prepared.
static void nsvcd__proof_begin(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd_question *q = task->question;
  const double unit = (double)task->motion.unit;
  nsvcd__proof *p = query->proof;
  p->intervals = query->intervals;
  p->ask.motion = &query->task.motion;
  p->moving = nsvcd__geometry_of(nsvcd__triangles_of(task->moving));
  p->fixed = nsvcd__geometry_of(nsvcd__triangles_of(task->fixed));
  p->given.lengths = task->motion.scale * p->moving.body->extent + p->fixed.body->extent;
  p->given.tolerance = (double)q->tolerance / unit;
  const double moving_radius = (double)p->moving.counts->convex_radius * task->motion.ratio;
  p->given.radius = moving_radius + (double)p->fixed.counts->convex_radius;
  p->given.clearance = (double)q->clearance / unit + p->given.radius;
  p->ask.clearance = p->given.clearance;
  p->given.slop = (double)q->slop / unit;
  const int is_verdict = q->ask != NSVCD_ASK_DISTANCE;
  const size_t most = is_verdict ? NSVCD_DEFAULT_VERDICT_WORK : NSVCD_DEFAULT_WORK;
  p->given.work = p->ask.limit = p->ask.most = q->work ? q->work : most;
  p->given.aside = (q->work ? q->work : NSVCD_DEFAULT_WORK) / NSVCD__AFTER_UNRESOLVED;
  p->given.grows = q->work == 0;
  p->given.tells = q->ask != NSVCD_ASK_HIT || p->given.slop > 0;
  p->ask.measure = p->ask.first = p->ask.fraction = p->low = p->given.fraction =
      p->given.width = 0;
  p->normal_count = 0;
  p->high = HUGE_VAL;
  p->work = 0;
  p->ask.collects = NSVCD__CONTACTS;
  p->ask.is_brief = p->inside = p->unclear = p->wide = p->starts_free = 0;
  p->in_open = 0;
  const double to = nsvcd__to_of(task);
  p->given.to = q->to > 0 && q->ask == NSVCD_ASK_FIRST ? to : 0;
  const int by_time = q->to_time > 0 && !(q->to > 0);
  if (q->ask == NSVCD_ASK_DISTANCE) p->given.width = to;
  if (q->ask == NSVCD_ASK_FIRST)
    p->given.fraction = nsvcd__fraction_of(p, by_time ? 0 : to, (double)q->to_time);
  p->ask.fraction = p->given.fraction;
  nsvcd__proof_restart(p);
}

// A time in [0,1] as a float that is not earlier: by then they have met.
static float nsvcd__time_above(double time) {
  const float rounded = (float)time;
  return (double)rounded < time ? nextafterf(rounded, 1) : rounded;
}

// The contact that a proof has found: when, where, and of what. Where the two were swapped it is
// the fixed body that counts as pushed out, the other way.
static NSVCD__NOINLINE void nsvcd__tell_contact(const nsvcd__query *query,
                                                const nsvcd__pair_contact *found,
                                                nsvcd_contact *out) {
  const nsvcd__proof *p = query->proof;
  const nsvcd__task *task = &query->task;
  const nsvcd__motion *motion = &task->motion;
  const int rests = motion->moving.count == 1 && !motion->fixed_moves;
  const double time = rests ? 0 : found->tick / (double)motion->ticks;
  const nsvcd__to_world world = nsvcd__to_world_at(motion, time);
  const nsvcd__d3 push_out = nsvcd__d3_scale(nsvcd__d3_widen(motion->push_out), task->swapped);
  const double beyond = fmin((double)p->fixed.counts->convex_radius, found->distance);
  const nsvcd__d3 on = nsvcd__d3_fma(beyond, found->normal, found->point);
  const nsvcd__d3 seen = nsvcd__d3_scale(nsvcd__d3_sub(on, push_out), world.unit);
  const nsvcd__d3 point =
      nsvcd__d3_add(nsvcd__dmat3_apply(&world.rotation, seen), world.position);
  const nsvcd__d3 normal = nsvcd__dmat3_apply(&world.rotation, found->normal);
  nsvcd__f3_store(nsvcd__f3_round(point), out->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), out->normal);
  out->gap = (float)(fmax(found->distance - p->given.radius, 0) * world.unit);
  out->time = nsvcd__time_above(time);
  out->triangle_a = found->moving_triangle;
  out->triangle_b = found->fixed_triangle;
  out->patch_a = found->moving_patch;
  out->patch_b = found->fixed_patch;
}

static nsvcd_pose nsvcd__pose_of(nsvcd__dquat turn, nsvcd__d3 position) {
  nsvcd_pose out;
  float *q = out.rotation;
  q[0] = (float)turn.x;
  q[1] = (float)turn.y;
  q[2] = (float)turn.z;
  q[3] = (float)turn.w;
  nsvcd__f3_store(nsvcd__f3_round(position), out.position);
  return out;
}

// Where both bodies are at time t, the one that takes the push-out displaced by so much, in the
// fixed one's frame and units. The one that moves takes it; if both do, a.
static int nsvcd__takes_push_out(const nsvcd__task *task) {
  return !task->swapped || !(task->motion.fixed_moves || task->motion.moving.count == 1);
}
static NSVCD__NOINLINE void nsvcd__poses_at(const nsvcd__task *task, double t,
                                            nsvcd__d3 push_out, nsvcd_pose *moving,
                                            nsvcd_pose *fixed) {
  const nsvcd__motion *motion = &task->motion;
  const int moving_takes_it = nsvcd__takes_push_out(task);
  const nsvcd__to_world world = nsvcd__to_world_at(motion, t);
  const nsvcd__d3 seen = nsvcd__dmat3_apply(&world.rotation, push_out);
  for (int n = 0; n < 2; n++) {
    const double by = n == moving_takes_it ? 0 : n ? -world.unit : world.unit;
    nsvcd__d3 position;
    const nsvcd__dquat turn =
        nsvcd__turn_at(motion, n ? &motion->fixed : &motion->moving, t, &position);
    position = nsvcd__d3_add(position, nsvcd__d3_scale(seen, by));
    *(n ? fixed : moving) = nsvcd__pose_of(turn, position);
  }
}

// How far the told poses at time t are from the bodies' own, at most: floats of positions and
// quaternions are off by 6e-8. In the fixed body's units.
static double nsvcd__told_allowance(const nsvcd__proof *p, double t) {
  const nsvcd__motion *motion = p->ask.motion;
  nsvcd__d3 moving, fixed;
  (void)nsvcd__turn_at(motion, &motion->moving, t, &moving);
  (void)nsvcd__turn_at(motion, &motion->fixed, t, &fixed);
  const double positions = nsvcd__d3_length(moving) + nsvcd__d3_length(fixed);
  return 1.3e-7 * (2 * positions / (double)motion->unit + (double)p->given.lengths);
}

// Sets the bodies down at time t, where they are free of each other when pushed out as the motion
// is: to a little more than what they are pressed in by at the start, or to a little before they
// are in contact. Returns how far they are pushed out then, which is proven to be free, and all the
// way down to it. All else that was known of the question is lost.
static NSVCD__NOINLINE nsvcd__d3 nsvcd__set_down(nsvcd__query *query, double t) {
  nsvcd__proof *p = query->proof;
  const nsvcd__task *task = &query->task;
  nsvcd__motion *whole = p->ask.motion;
  nsvcd__motion down = *whole;
  nsvcd_pose moving[2], fixed[2];
  const int takes_it = nsvcd__takes_push_out(task);
  const nsvcd__track moves = {moving, NULL, takes_it ? 2u : 1u, 0, 0};
  const nsvcd__track rests = {fixed, NULL, takes_it ? 1u : 2u, 0, 0};
  const nsvcd__d3 push_out = nsvcd__d3_widen(whole->push_out);
  // nearer to each other than stored triangles are known, nothing would be separated
  const double epsilons = 4 * nsvcd__epsilon(p) + nsvcd__told_allowance(p, t);
  const double kept = fmax(NSVCD__SET_DOWN * p->ask.slop, epsilons);
  const nsvcd__d3 least = nsvcd__push_out(p, kept, 1);
  const nsvcd__d3 by = nsvcd__d3_sub(push_out, least);
  const double length = nsvcd__d3_length(by);
  if (!(nsvcd__d3_dot(by, push_out) > 0) || !(length > kept)) return push_out;
  nsvcd__poses_at(task, t, push_out, &moving[0], &fixed[0]);
  nsvcd__poses_at(task, t, least, &moving[1], &fixed[1]);
  nsvcd__motion_set_tracks(&down, moves, rests);
  down.push_out = nsvcd__f3_of(0, 0, 0);
  p->ask.motion = &down;
  p->ask.fraction = kept / length;
  p->ask.measure = 0;
  p->ask.clearance = p->given.clearance;
  p->ask.limit = p->work + p->given.aside;
  (void)nsvcd__prove_anew(p, &query->broad_phase);
  p->ask.motion = whole;
  const double until = nsvcd__clear_until(p) / (double)down.ticks;
  // up to an unresolved pair it is proven, but not so that it is proven anew from there
  const double clear =
      p->known.unresolved < p->ask.end ? until - 0.5 * p->ask.fraction : until;
  return nsvcd__d3_sub(push_out, nsvcd__d3_scale(by, fmin(fmax(clear, 0), 1)));
}

// The bodies as they are at time t, as a motion of its own, with the fixed one's origin in the
// world's: places in its frame are as exact as if it were there.
static nsvcd__motion nsvcd__rest_at(const nsvcd__task *task, double t, nsvcd_pose *poses) {
  nsvcd__motion still = task->motion;
  const nsvcd__track tracks[2] = {{&poses[0], NULL, 1, 0, 0}, {&poses[1], NULL, 1, 0, 0}};
  const nsvcd__d3 here = {0, 0, 0};
  nsvcd__d3 position, origin;
  const nsvcd__dquat turn = nsvcd__turn_at(&still, &still.moving, t, &position);
  const nsvcd__dquat fixed_turn = nsvcd__turn_at(&still, &still.fixed, t, &origin);
  const nsvcd__dmat3 rotation = nsvcd__dmat3_of(fixed_turn);
  const nsvcd__d3 push_out = nsvcd__dmat3_apply(&rotation, nsvcd__d3_widen(still.push_out));
  position = nsvcd__d3_sub(position, origin);
  position = nsvcd__d3_add(position, nsvcd__d3_scale(push_out, (double)still.unit));
  poses[0] = nsvcd__pose_of(turn, position);
  poses[1] = nsvcd__pose_of(fixed_turn, here);
  nsvcd__motion_set_tracks(&still, tracks[0], tracks[1]);
  still.push_out = nsvcd__f3_of(0, 0, 0);
  return still;
}

// The directions that the contacts of a manifold may be about: the normal of the contact that was
// found, and those of its faces that are not against it, where the bodies do not leave along them.
// Returns how many. How the bodies go: 0 at the start, where they only touch.
static NSVCD__NOINLINE int nsvcd__manifold_normals(nsvcd__proof *p,
                                                   const nsvcd__pair_contact *found,
                                                   nsvcd__twist *twist, nsvcd__d3 *normals) {
  nsvcd__approach now;
  int count = 1;
  nsvcd__approach_at(p, found, found->tick, &now);
  memset(twist, 0, sizeof *twist);
  if (found->tick > 0) *twist = now.twist;
  p->of.kept.manifold.normal = normals[0] = found->normal;
  const nsvcd__facing facing = nsvcd__facing_of(p, &now.pair, now.contact.moving);
  for (int k = 1; k >= 0; k--) {
    const nsvcd__d3 n = facing.faces[k];
    const nsvcd__d3 all[2] = {found->normal, found->normal};
    int is_new = nsvcd__d3_dot(n, found->normal) > -0.1;
    is_new &= !nsvcd__is_left(twist, found->point, n, all);
    for (int i = 0; i < count; i++) is_new &= nsvcd__d3_dot(n, normals[i]) <= 0.9;
    if (is_new) normals[count++] = n;
  }
  return count;
}

// The manifold of the contact that was found. Where a body stands, that may be one of a side that
// rises from what it stands on: the normal of either triangle is tried, and what intervals more
// counts. All else that was known of the question is lost.
static NSVCD__NOINLINE void nsvcd__tell_manifold(nsvcd__query *query, nsvcd_answer *answer) {
  nsvcd__proof *p = query->proof;
  const nsvcd__task *task = &query->task;
  const nsvcd__pair_contact found = p->known.found;
  const nsvcd__asked asked = p->ask;
  const double epsilon = nsvcd__epsilon(p);
  const double same = epsilon + 1e-5 * (double)p->given.lengths;
  const float radius = task->motion.scale * task->moving->radius;
  const double extent = (double)fminf(radius, task->fixed->radius);
  const nsvcd__manifold *m = &p->of.kept.manifold;
  nsvcd__d3 normals[3];
  double widest = -1;
  nsvcd_pose poses[2];
  nsvcd__twist twist;
  int tries = nsvcd__manifold_normals(p, &found, &twist, normals);
  nsvcd__motion still = nsvcd__rest_at(task, (double)answer->nearest.time, poses);
  p->ask.motion = &still;
  p->ask.collects = NSVCD__SUPPORTING;
  p->ask.clearance = p->given.clearance + fmax(nsvcd__to_of(task), 4 * epsilon);
  p->ask.limit = p->work + p->given.aside;
  (void)nsvcd__prove_anew(p, &query->broad_phase);
  for (int k = 0; k < tries; k++) {
    int chosen[NSVCD_MAX_CONTACTS];
    double area;
    nsvcd__manifold_begin(p, normals[k], &twist, p->ask.clearance, same);
    nsvcd__seek_positions(p, 0, NSVCD__AROUND);
    int count = nsvcd__choose_four(m, chosen, &area);
    if (nsvcd__seek_across(&p->of.kept.manifold, area)) {
      nsvcd__seek_positions(p, NSVCD__AROUND, NSVCD__SUPPORTS);
      count = nsvcd__choose_four(m, chosen, &area);
    }
    if (count == 0 || !(area > 1.001 * widest)) continue;
    widest = area;
    if (count > 2 && area > 0.1 * extent * extent) tries = 1;
    answer->contact_count = (size_t)count;
    for (int n = 0; n < count; n++) {
      nsvcd__pair_contact support = m->supports[chosen[n]];
      support.tick = found.tick;
      nsvcd__tell_contact(query, &support, &answer->contacts[n]);
      // which body a corner is of
      answer->contacts[n].id = m->numbers[chosen[n]] ^ (uint32_t)task->swapped;
    }
  }
  p->ask = asked;
}

// Where the bodies may go, which are proven free until answer->time.low; and how deep they are in
// contact at the start. Where one may be inside of the other no push-out helps, and they stay.
static NSVCD__NOINLINE void nsvcd__tell_safe_pose(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const nsvcd__proof *p = query->proof;
  const double t = (double)answer->safe.time;
  nsvcd__d3 push_out = nsvcd__d3_widen(task->motion.push_out);
  const int is_lifted = nsvcd__d3_dot(push_out, push_out) > 0;
  const int may_go = is_lifted && !p->inside && !p->unclear;
  if (is_lifted && !p->inside) {
    const double depth = nsvcd__d3_length(nsvcd__push_out(p, 0, 1));
    answer->depth = (float)(depth * (double)task->motion.unit);
  } else if (!is_lifted && (answer->time.low > 0 || p->starts_free)) {
    answer->depth = 0;
  }
  if (may_go) push_out = nsvcd__set_down(query, t);
  // at the ends they are as the caller has them: nsvcd__answer_begin
  if (may_go || (t > 0 && t < 1))
    nsvcd__poses_at(task, t, push_out, &answer->safe.a, &answer->safe.b);
}

// Why not all is answered. More work, or finer triangles, would not tell what is in an open solid.
static void nsvcd__resolve_why(const nsvcd__proof *p, nsvcd_answer *answer) {
  const int is_near = p->known.unresolved < NSVCD__NEVER || p->unclear;
  if (p->wide || answer->verdict == NSVCD_UNDECIDED) answer->why = NSVCD_WHY_WORK;
  if (answer->why && !p->wide && is_near) answer->why = NSVCD_WHY_TOO_NEAR;
  if (answer->why && p->in_open) answer->why = NSVCD_WHY_OPEN;
}

// Proves a question whose motion has been prepared, if it can.
static void nsvcd__answer_by_proof(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const nsvcd_question *q = task->question;
  const double unit = (double)task->motion.unit;
  nsvcd__search *search = &query->broad_phase;
  nsvcd__proof *p = query->proof;
  nsvcd__proof_begin(query);
  if (p->given.slop > 0) nsvcd__push_out_motion(p, search);
  nsvcd__finding verdict = nsvcd__prove(p, search);
  if (p->given.width > 0 && verdict != NSVCD__FOUND_INSIDE) {
    nsvcd__measure(p, search, verdict, p->given.width);
    // A distance decides what was left undecided, but tells nothing of what is inside of what.
    const int meets = p->known.has_contact && p->known.found.distance <= p->given.clearance;
    const int is_clear =
        p->low > 0 && p->low >= p->given.clearance && !p->unclear && !p->inside;
    if (verdict == NSVCD__FOUND_NEITHER && (meets || is_clear))
      verdict = meets ? NSVCD__FOUND_CONTACT : NSVCD__FOUND_FREE;
  }

  // The triangles that the answer names are those of a contact, or else of an unresolved pair.
  const int has_unresolved = p->known.unresolved < NSVCD__NEVER;
  const int names =
      p->known.has_contact || (verdict == NSVCD__FOUND_NEITHER && has_unresolved);
  const int is_inside = verdict == NSVCD__FOUND_INSIDE;
  if (names && !is_inside) nsvcd__resolve_normal(p);
  const int is_free = verdict == NSVCD__FOUND_FREE;
  const int is_hit = is_inside || verdict == NSVCD__FOUND_CONTACT;
  nsvcd__answer_begin(task,
                      is_free  ? NSVCD_FREE
                      : is_hit ? NSVCD_HIT
                               : NSVCD_UNDECIDED,
                      answer);
  answer->inside = is_inside;
  if (names || is_inside) nsvcd__tell_contact(query, &p->known.found, &answer->nearest);
  if (is_inside) answer->nearest.gap = HUGE_VALF;
  if (is_hit) answer->time.high = answer->nearest.time;
  if (verdict == NSVCD__FOUND_CONTACT)
    answer->contacts[answer->contact_count++] = answer->nearest;

  // What is proven of times and distances.
  if (p->given.fraction > 0 && !is_free && !is_inside) {
    const nsvcd__motion *motion = p->ask.motion;
    const double ticks = (double)motion->ticks;
    const double until = fmin(fmax(nsvcd__clear_until(p) / ticks, 0), 1);
    const double late = (double)answer->time.high - until;
    answer->time.low = (float)(until * (1 - 1e-7));
    if (late > p->given.fraction * 1.0001 + 1e-6) answer->why = NSVCD_WHY_WORK;
    // Closer poses are proven free here, but a new query from there could not prove it again.
    double u;
    const nsvcd__arc *arc = nsvcd__arc_at(p, nsvcd__arc_of(motion, until * ticks, &u));
    const double length = nsvcd__way_in(p, arc) * ticks / (double)arc->ticks;
    const double epsilons =
        NSVCD__EPSILONS * nsvcd__epsilon(p) + nsvcd__told_allowance(p, until);
    const double back = length > epsilons ? epsilons / length : p->given.fraction;
    answer->safe.time = (float)(fmax(0, until - back) * (1 - 1e-7));
  }
  const double low = (is_free ? fmax(p->given.clearance, p->low) : p->low) - p->given.radius;
  double high = names ? p->known.found.distance : p->high;
  // what was found, or moved to where it is nearer, may have made it narrow enough
  p->wide = p->wide && high - p->low > p->given.width;
  if (names) {
    const double off = nsvcd__off_meshes(p) + 1e-12 * (double)p->given.lengths;
    high = fmax(high, p->given.radius) + off;
  }
  high = fmax(high - p->given.radius, 0);
  answer->distance.low = (float)(fmax(low, 0) * unit * (1 - 1e-6));
  answer->distance.high = is_inside ? 0 : (float)(high * unit * (1 + 1e-6));
  nsvcd__resolve_why(p, answer);

  // By what the moving body was pushed out, in the world at the start.
  const nsvcd__d3 push_out = nsvcd__d3_widen(task->motion.push_out);
  if (nsvcd__d3_dot(push_out, push_out) > 0) {
    const nsvcd__to_world start = nsvcd__to_world_at(&task->motion, 0);
    const nsvcd__d3 turned = nsvcd__dmat3_apply(&start.rotation, push_out);
    nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(turned, start.unit)), answer->push_out);
  }
  if (q->manifold && verdict == NSVCD__FOUND_CONTACT) nsvcd__tell_manifold(query, answer);
  nsvcd__tell_safe_pose(query, answer);
  answer->work = p->work;
}
#endif  // NSVCD_NO_PROOF
