// In: movers of a world, and a time. Out: a frame of all of them: each has moved, or sleeps.
//
// The lowest moves first: what is to fall on something finds it where it will be. The order is kept
// from frame to frame, in which it hardly changes.
#pragma once
#include "carry.h"

// metres a second; seconds
#define NSVCD__USUAL_QUIET 0.15
#define NSVCD__USUAL_CALM 0.1
// what touches something, and is slower than so many times `quiet`, is nearly quiet
#define NSVCD__NEARLY_QUIET 2.7
// a second: how much of its speed, of its spin, and of both while it is nearly quiet, what touches
// something loses
#define NSVCD__BRAKES_SPEED 0.3
#define NSVCD__BRAKES_SPIN 1.2
#define NSVCD__BRAKES_QUIET 10.0
// who has come by less than this part of the way that it asked for has stood
#define NSVCD__STANDS 0.1

// ---- what is asked for

static nsvcd_result nsvcd__check_mover(const nsvcd__crowd *crowd, size_t k) {
  const nsvcd_world_mover *m = &crowd->movers[k];
  const nsvcd__resident *r = nsvcd__resident_of(crowd->world, m->id);
  nsvcd_velocity falls = m->velocity;
  if (!r || r->mover != k || r->given.fixed) return NSVCD_ERROR_INDEX;
  if (!nsvcd__is_amount(m->push_mass) || !nsvcd__is_amount(m->damping) ||
      !nsvcd__is_amount(m->spin_damping))
    return NSVCD_ERROR_VALUE;
  const nsvcd__d3 then = nsvcd__d3_add(nsvcd__d3_load(falls.linear), crowd->falls);
  nsvcd__f3_store(nsvcd__d3_narrow(then), falls.linear);
  const nsvcd_result result = nsvcd__slide_check(&m->how, crowd->seconds, &m->velocity);
  return result ? result : nsvcd__slide_check(&m->how, crowd->seconds, &falls);
}

// Checks what is asked for, before anything moves. *refused: the body at fault.
static nsvcd_result nsvcd__step_begin(nsvcd_world *world, nsvcd_world_mover *movers,
                                      size_t count, const nsvcd_step_options *options,
                                      float seconds, nsvcd__crowd *crowd, size_t *refused) {
  const float *gravity = options->gravity;
  if (world->changes & 1) return NSVCD_ERROR_WORLD;
  if (!nsvcd__is_finite(seconds) || !(seconds > 0)) return NSVCD_ERROR_TIMES;
  if (!nsvcd__is_amount(options->calm)) return NSVCD_ERROR_TIMES;
  if (!nsvcd__is_amount(options->quiet)) return NSVCD_ERROR_SPEED;
  if (!nsvcd__in_range(gravity, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_VALUE;
  if (count > world->most) return NSVCD_ERROR_INDEX;
  crowd->world = world;
  crowd->movers = movers;
  crowd->count = count;
  crowd->seconds = seconds;
  crowd->falls = nsvcd__d3_scale(nsvcd__d3_load(gravity), (double)seconds);
  crowd->up = nsvcd__d3_unit(nsvcd__d3_scale(crowd->falls, -1), nsvcd__d3_of(0, 0, 0));
  crowd->quiet = options->quiet > 0 ? (double)options->quiet : NSVCD__USUAL_QUIET;
  crowd->calm = options->calm > 0 ? (double)options->calm : NSVCD__USUAL_CALM;
  for (size_t k = 0; k < count; k++) {
    nsvcd__resident *r = nsvcd__resident_of(world, movers[k].id);
    if (r) r->mover = (uint32_t)k;
  }
  for (size_t k = 0; k < count; k++) {
    *refused = movers[k].id;
    const nsvcd_result result = nsvcd__check_mover(crowd, k);
    if (result) return result;
  }
  *refused = NSVCD_NOBODY;
  return NSVCD_OK;
}

// ---- the order

static int nsvcd__comes_before(nsvcd__turn a, nsvcd__turn b) {
  if (a.height < b.height || a.height > b.height) return a.height < b.height;
  return a.mover < b.mover;
}

// Sorts movers by their heights, and those of a height as they are numbered (Shell 1959).
static void nsvcd__sort_turns(const nsvcd__crowd *crowd) {
  nsvcd_world *world = crowd->world;
  nsvcd__turn *turns = world->turns;
  for (size_t k = 0; k < crowd->count && world->turn_count != crowd->count; k++)
    turns[k].mover = (uint32_t)k;
  world->turn_count = (uint32_t)crowd->count;
  for (size_t k = 0; k < crowd->count; k++) {
    const nsvcd__resident *r = &world->residents[crowd->movers[turns[k].mover].id];
    const nsvcd__d3 at = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
    turns[k].height = (float)-nsvcd__d3_dot(at, crowd->falls);
  }
  for (size_t gap = crowd->count; gap > 1;) {
    gap = gap > 2 ? gap * 5 / 11 : 1;
    for (size_t k = gap; k < crowd->count; k++) {
      const nsvcd__turn turn = turns[k];
      size_t n = k;
      for (; n >= gap && nsvcd__comes_before(turn, turns[n - gap]); n -= gap)
        turns[n] = turns[n - gap];
      turns[n] = turn;
    }
  }
}

// ---- sleep

// Metres a second that no point of a mover exceeds.
static double nsvcd__mover_speed(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const double spin = nsvcd__d3_norm(nsvcd__d3_load(m->velocity.angular));
  const double speed = nsvcd__d3_norm(nsvcd__d3_load(m->velocity.linear));
  return speed + spin * crowd->world->residents[m->id].shape.reach;
}

// Has a body been moved since a mover's slide, and not by a slide of its own?
static int nsvcd__was_moved(const nsvcd__crowd *crowd, size_t id, uint64_t since) {
  const nsvcd__resident *r = nsvcd__resident_of(crowd->world, id);
  const nsvcd_world_mover *m = nsvcd__mover_with(crowd, id);
  return !r || (r->moved > since && (!m || r->moved > m->answer.clock));
}

// Is there something that a sleeping mover wakes by?
static int nsvcd__is_disturbed(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const nsvcd_slide_answer *last = &m->answer;
  if (nsvcd__mover_speed(crowd, m) > 0) return 1;
  if (!nsvcd__is_last_slide(crowd->world, m->id, last)) return 1;
  if (last->clock && nsvcd__was_moved(crowd, m->id, last->clock)) return 1;
  for (size_t k = 0; k < last->contact_count && k < NSVCD_WORLD_CONTACTS; k++) {
    const nsvcd_world_mover *other = nsvcd__mover_with(crowd, last->contacts[k].body);
    if (nsvcd__was_moved(crowd, last->contacts[k].body, last->clock)) return 1;
    if (other && other->how.mass > 0 && nsvcd__mover_speed(crowd, other) > crowd->quiet)
      return 1;
  }
  return 0;
}

// Wakes whoever sleeps where something is driven. Returns whether something is.
static int nsvcd__wake_near_driven(const nsvcd__crowd *crowd) {
  nsvcd_world *world = crowd->world;
  int is_driven = 0;
  double within = 0;
  for (size_t k = 0; k < crowd->count; k++) {
    const nsvcd_slide_options *how = &crowd->movers[k].how;
    const double reach = world->residents[crowd->movers[k].id].shape.reach;
    const double clearance = nsvcd__kept_clearance(how, reach);
    const double margin = how->margin > 0 ? (double)how->margin : clearance;
    within = nsvcd__max(within, clearance + 2 * margin);
  }
  for (uint32_t id = 1; id <= world->count; id++) {
    const nsvcd__resident *r = nsvcd__resident_of(world, id);
    if (!r || !r->is_driven) continue;
    is_driven = 1;
    const nsvcd__box box = nsvcd__box_around(r->box, within);
    for (uint32_t n = 0; (n = nsvcd__tree_next(&world->tree, n, &box)) != 0;) {
      nsvcd_world_mover *m = nsvcd__mover_with(crowd, n);
      if (m && m->asleep) nsvcd__wake(m);
    }
  }
  return is_driven;
}

// What was quiet for long enough falls asleep.
static void nsvcd__grow_calm(const nsvcd__crowd *crowd, nsvcd_world_mover *m) {
  const int is_quiet =
      m->answer.contact_count > 0 && nsvcd__mover_speed(crowd, m) < crowd->quiet;
  if (m->asleep || m->sleepless || !(m->how.mass > 0)) return;
  m->calm = is_quiet ? m->calm + crowd->seconds : 0;
  if ((double)m->calm < crowd->calm - 0.5 * (double)crowd->seconds) return;
  m->asleep = 1;
  memset(&m->velocity, 0, sizeof m->velocity);
}

// ---- a frame

// Gives a mover what gravity adds to its speed, less what brakes it, as seen from what it stands
// on.
static void nsvcd__pull_and_brake(const nsvcd__crowd *crowd, nsvcd_world_mover *m) {
  const int is_carried = crowd->world->residents[m->id].carrier != NSVCD_NOBODY;
  const int is_braked = m->answer.contact_count > 0 && m->how.mass > 0 && m->how.friction > 0;
  // a lift that speeds up would hold by brakes what friction does not
  const int is_slow = is_braked && !is_carried &&
                      nsvcd__mover_speed(crowd, m) < NSVCD__NEARLY_QUIET * crowd->quiet;
  const double quiet = is_slow ? NSVCD__BRAKES_QUIET : 0;
  const double speed = is_braked ? nsvcd__max(NSVCD__BRAKES_SPEED, quiet) : 0;
  const double spin = is_braked ? nsvcd__max(NSVCD__BRAKES_SPIN, quiet) : 0;
  const double seconds = (double)crowd->seconds;
  size_t n = 0;
  const nsvcd__resident *beneath = nsvcd__next_beneath(crowd, m, &n);
  nsvcd__d3 goes = {0, 0, 0};
  if (beneath) goes = nsvcd__takes_along(crowd, beneath, nsvcd__mover_centre(crowd, m));
  const nsvcd__d3 linear = nsvcd__d3_add(nsvcd__d3_load(m->velocity.linear), crowd->falls);
  const nsvcd__d3 seen = nsvcd__d3_sub(linear, goes);
  const nsvcd__d3 angular = nsvcd__d3_load(m->velocity.angular);
  nsvcd__thing thing;
  memset(&thing, 0, sizeof thing);
  thing.linear =
      nsvcd__d3_add(goes, nsvcd__d3_over(seen, 1 + seconds * (speed + (double)m->damping)));
  thing.angular = nsvcd__d3_over(angular, 1 + seconds * (spin + (double)m->spin_damping));
  nsvcd__tell_velocity(&thing, &m->velocity);
}

static nsvcd_result nsvcd__step_mover(const nsvcd__crowd *crowd, nsvcd_world_mover *m,
                                      void *workspace, size_t size, nsvcd_step_answer *out) {
  nsvcd__resident *r = &crowd->world->residents[m->id];
  if (m->asleep || r->is_driven) return NSVCD_OK;
  const nsvcd_velocity was = m->velocity;
  const nsvcd__d3 from = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
  const int is_carried = r->carrier != NSVCD_NOBODY;
  const nsvcd__d3 none = {0, 0, 0};
  // a character's speed is its own already
  const int is_thing = is_carried && m->how.mass > 0;
  const nsvcd__d3 goes = is_carried ? r->goes : none;
  const nsvcd__d3 turns = is_carried ? r->turns : none;
  if (is_thing) nsvcd__add_carried(goes, turns, -1, &m->velocity);
  nsvcd__pull_and_brake(crowd, m);
  nsvcd_velocity came = m->velocity;
  nsvcd__hold holds[NSVCD_WORLD_CONTACTS];
  const nsvcd_result result =
      nsvcd__slide_and_tell(crowd->world, m->id, &m->how, crowd->seconds, workspace, size,
                            &m->velocity, &m->answer, holds);
  if (result) {
    m->velocity = was;
    return result;
  }
  if (is_thing) nsvcd__add_carried(none, turns, 1, &came);
  if (is_thing) nsvcd__add_carried(none, turns, 1, &m->velocity);
  const nsvcd__d3 to = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
  const double asked = nsvcd__d3_norm(nsvcd__d3_load(came.linear)) * (double)crowd->seconds;
  const int stands = nsvcd__d3_norm(nsvcd__d3_sub(to, from)) < NSVCD__STANDS * asked;
  r->stood = stands ? (r->stood > 0 ? 2 : 1) : 0;
  nsvcd__share_momentum(crowd, m, &came, goes, holds);
  r->slips = is_thing ? nsvcd__d3_load(m->velocity.linear) : none;
  if (is_thing) nsvcd__add_carried(goes, none, 1, &m->velocity);
  out->awake++;
  out->caught += m->answer.caught != NSVCD_NOBODY;
  out->contacts += m->answer.contact_count;
  out->questions += m->answer.questions;
  out->work += m->answer.work;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_step(nsvcd_world *world, nsvcd_world_mover *movers,
                                       size_t count, const nsvcd_step_options *options,
                                       float seconds, void *workspace, size_t workspace_size,
                                       nsvcd_step_answer *answer) {
  static const nsvcd_step_options usual = {{0, 0, 0}, 0, 0};
  nsvcd__crowd crowd;
  nsvcd_step_answer out;
  if (!world || (count > 0 && !movers)) return NSVCD_ERROR_ARGUMENT;
  const int has_workspace = workspace && nsvcd__is_aligned(workspace) &&
                            workspace_size >= nsvcd_sweep_workspace_size(NULL);
  memset(&out, 0, sizeof out);
  nsvcd_result result = nsvcd__step_begin(world, movers, count, options ? options : &usual,
                                          seconds, &crowd, &out.refused);
  if (!result && !has_workspace) result = NSVCD_ERROR_WORKSPACE;
  if (answer) answer->refused = out.refused;
  if (result) return result;
  nsvcd__sort_turns(&crowd);
  for (size_t k = 0; k < count; k++) {
    nsvcd_world_mover *m = &movers[k];
    const int was_woken = !m->asleep && (double)m->calm >= crowd.calm;
    if (was_woken || (m->asleep && nsvcd__is_disturbed(&crowd, m))) nsvcd__wake(m);
  }
  const int is_driven = nsvcd__wake_near_driven(&crowd);
  if (is_driven) nsvcd__carry_all(&crowd, workspace, workspace_size, &out);
  // who is carried slides when all that is driven has arrived
  for (int carried = 0; carried <= is_driven; carried++) {
    for (size_t k = 0; k < count; k++) {
      nsvcd_world_mover *m = &movers[world->turns[k].mover];
      if ((world->residents[m->id].carrier != NSVCD_NOBODY) != carried) continue;
      const nsvcd_result said = nsvcd__step_mover(&crowd, m, workspace, workspace_size, &out);
      if (said && !result) {
        result = said;
        out.refused = m->id;
      }
    }
    const nsvcd_result arrives = nsvcd_world_arrive(world);
    if (!result) result = arrives;
  }
  for (size_t k = 0; k < count; k++) {
    const nsvcd_pose *at = &world->residents[movers[k].id].given.pose;
    if (memcmp(&movers[k].answer.pose, at, sizeof *at)) {  // it was driven, or never slid
      movers[k].answer.pose = *at;
      movers[k].answer.rests = 0;
    }
    nsvcd__grow_calm(&crowd, &movers[k]);
    out.asleep += movers[k].asleep != 0;
  }
  if (is_driven) nsvcd__end_carrying(world);
  if (answer) *answer = out;
  return result;
}
