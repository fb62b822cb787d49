// In: movers, and what is driven in this frame. Out: whoever stands on something driven, be it by
// way of others, has gone along with it.
//
// As a lift sees it, a stack on it is at rest. So all of it moves in the frame of the lift: first
// it goes along, at the same time as the lift; and when all that is driven has arrived, each slides
// at the speed that it has besides, and gets that of the lift again.
//
// Going along is proven as any way is: against all that rests, and all that is driven or carried
// meanwhile. A mover that is in the way is carried too, as is what a lift comes up into. Who cannot
// go along stays, as does whoever stands on it: they slide while the lift moves, as those do who
// stand on nothing driven.
#pragma once
#include "momentum.h"

// radians: what turns by more in a frame carries nobody
#define NSVCD__CARRIES_TURN 0.5
// metres a second: what carries a point as fast as another to this does so as one with it
#define NSVCD__CARRIES_SAME 1e-3
// of the clearance: how near those who are carried may come to what moves with them, by rounding
#define NSVCD__CARRIES_WITHIN 0.5f
// rounds in which those who stay are found; then all stay
#define NSVCD__CARRY_ROUNDS 20

static nsvcd__d3 nsvcd__mover_centre(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const nsvcd__resident *r = &crowd->world->residents[m->id];
  return nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
}

// How fast a driven body takes a point along that is there now, metres a second; 0: it is not
// driven.
static nsvcd__d3 nsvcd__takes_along(const nsvcd__crowd *crowd, const nsvcd__resident *r,
                                    nsvcd__d3 point) {
  if (!r->is_driven) return nsvcd__d3_of(0, 0, 0);
  const nsvcd__dpose from = nsvcd__dpose_of(&r->given.pose);
  const nsvcd__d3 moved = nsvcd__moved_along(&from, &r->to, point);
  return nsvcd__d3_over(moved, (double)crowd->seconds);
}

// The next body beneath a mover, as it was after its last slide, from contact *n on; or NULL.
static const nsvcd__resident *nsvcd__next_beneath(const nsvcd__crowd *crowd,
                                                  const nsvcd_world_mover *m, size_t *n) {
  while (*n < m->answer.contact_count && *n < NSVCD_WORLD_CONTACTS) {
    const nsvcd_world_contact *c = &m->answer.contacts[(*n)++];
    const nsvcd__resident *r = nsvcd__resident_of(crowd->world, c->body);
    if (r && nsvcd__d3_dot(nsvcd__d3_load(c->contact.normal), crowd->up) > 0.5) return r;
  }
  return NULL;
}

// Which driven body carries a mover; or nobody. Who stands on something else too slides.
static uint32_t nsvcd__carrier_of(const nsvcd__crowd *crowd, const nsvcd_world_mover *m) {
  const nsvcd__resident *all = crowd->world->residents;
  const nsvcd__d3 centre = nsvcd__mover_centre(crowd, m);
  const nsvcd__resident *r;
  nsvcd__d3 goes = {0, 0, 0};
  uint32_t out = all[m->id].joins;
  if (all[m->id].stays || out) return all[m->id].stays ? NSVCD_NOBODY : out;
  for (size_t n = 0; (r = nsvcd__next_beneath(crowd, m, &n)) != NULL;) {
    const uint32_t id = r->carrier ? r->carrier : r->is_driven ? (uint32_t)(r - all) : 0;
    const nsvcd__d3 other = nsvcd__takes_along(crowd, &all[id], centre);
    const double differs = out ? nsvcd__d3_norm(nsvcd__d3_sub(other, goes)) : 0;
    if (!id || differs > NSVCD__CARRIES_SAME) return NSVCD_NOBODY;
    if (!out) goes = other;
    if (!out) out = id;
  }
  return out;
}

// Has a mover go along with a driven body, over the frame as that does; or, with nobody, stay.
static void nsvcd__carry(const nsvcd__crowd *crowd, nsvcd_world_mover *m, uint32_t carrier) {
  nsvcd_world *world = crowd->world;
  nsvcd__resident *r = &world->residents[m->id];
  const nsvcd__resident *by = &world->residents[carrier];
  const nsvcd_pose stays = r->given.pose;
  int goes = carrier != NSVCD_NOBODY;
  if (goes) {
    const nsvcd__slerp slerp = nsvcd__slerp_of(&by->given.pose, &by->to);
    const nsvcd__dpose from = nsvcd__dpose_of(&by->given.pose);
    const nsvcd__d3 turn = nsvcd__slerp_turn(&slerp);
    nsvcd__dpose to = nsvcd__unit_dpose(&stays);
    const nsvcd__dquat by_turn =
        nsvcd__dquat_mul(slerp.end, nsvcd__dquat_inverse(slerp.start));
    to.position = nsvcd__d3_add(to.position, nsvcd__moved_along(&from, &by->to, to.position));
    to.rotation = nsvcd__dquat_mul(by_turn, to.rotation);
    const nsvcd_pose end = nsvcd__dpose_round(&to);
    r->goes = nsvcd__takes_along(crowd, by, nsvcd__mover_centre(crowd, m));
    r->turns = nsvcd__d3_over(turn, (double)crowd->seconds);
    goes = nsvcd__d3_norm(turn) < NSVCD__CARRIES_TURN &&
           !nsvcd__world_place(world, m->id, &end, 1);
    if (m->asleep) nsvcd__wake(m);
  }
  r->stays |= carrier && !goes;
  r->carrier = goes ? carrier : NSVCD_NOBODY;
  if (!goes) (void)nsvcd__world_place(world, m->id, &stays, 0);
}

// Turns a mover into one who asks whether it is free.
static nsvcd_result nsvcd__carried_asker(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                                         void *workspace, size_t size, nsvcd__asker *q) {
  const nsvcd__resident *r = &crowd->world->residents[m->id];
  nsvcd_world_question asked;
  memset(&asked, 0, sizeof asked);
  asked.self = m->id;
  asked.question.clearance = (float)nsvcd__kept_clearance(&m->how, r->shape.reach);
  asked.question.work = m->how.work ? m->how.work : NSVCD_DEFAULT_SLIDE_WORK;
  return nsvcd__asker_begin(crowd->world, &asked, workspace, size, q);
}

// What is driven up into a mover where it is lifts it, as what it stands on does; or nobody.
static uint32_t nsvcd__lifter_of(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                                 void *workspace, size_t size, nsvcd_step_answer *out) {
  const nsvcd__d3 centre = nsvcd__mover_centre(crowd, m);
  uint32_t found = NSVCD_NOBODY;
  nsvcd__asker q;
  if (nsvcd__carried_asker(crowd, m, workspace, size, &q)) return found;
  for (uint32_t id = 0; !found && (id = nsvcd__asker_next(&q, id)) != 0;) {
    const nsvcd__resident *o = &crowd->world->residents[id];
    const nsvcd__d3 goes = nsvcd__takes_along(crowd, o, centre);
    nsvcd_answer answer;
    if (o->carrier || !(nsvcd__d3_dot(goes, crowd->up) > 0.5 * nsvcd__d3_norm(goes))) continue;
    if (nsvcd__ask_about(&q, id, &answer) && answer.verdict != NSVCD_FREE) found = id;
  }
  out->questions += q.questions;
  out->work += q.work;
  return found;
}

// Is the way on which a mover is carried free? What is known since neither of two has changed is
// not asked again. If it is not, the mover stays, or what it meets is carried too.
static int nsvcd__may_go_along(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                               void *workspace, size_t size, nsvcd_step_answer *out) {
  nsvcd__asker q;
  nsvcd_world *world = crowd->world;
  nsvcd__resident *r = &world->residents[m->id];
  const nsvcd_pose way[2] = {r->given.pose, r->to};
  r->stays = nsvcd__carried_asker(crowd, m, workspace, size, &q) != NSVCD_OK;
  if (r->stays) return 0;
  const float clearance = q.question.clearance;
  nsvcd__asker_goes(&q, way, 2);
  int is_free = 1;
  for (uint32_t id = 0; is_free && (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd__resident *o = &world->residents[id];
    const uint64_t moved = r->moved > o->moved ? r->moved : o->moved;
    nsvcd_answer answer;
    if (r->proven >= moved || o->proven >= moved) continue;
    q.question.clearance = o->is_driven ? NSVCD__CARRIES_WITHIN * clearance : clearance;
    is_free = nsvcd__ask_about(&q, id, &answer) && answer.verdict == NSVCD_FREE;
    if (is_free) continue;
    const int may_join = nsvcd__mover_with(crowd, id) && !o->is_driven && !o->stays;
    if (may_join) o->joins = r->carrier;
    r->stays = !may_join;
  }
  if (is_free) r->proven = world->clock;
  out->questions += q.questions;
  out->work += q.work;
  return is_free;
}

// Finds who is carried, by what and how far, and has them go there.
static void nsvcd__carry_all(const nsvcd__crowd *crowd, void *workspace, size_t size,
                             nsvcd_step_answer *out) {
  const nsvcd_world *world = crowd->world;
  int more = 1;
  for (int round = 0; more; round++) {
    more = 0;
    // the lowest first: what it stands on comes before it
    for (size_t k = 0; k < crowd->count; k++) {
      nsvcd_world_mover *m = &crowd->movers[world->turns[k].mover];
      nsvcd__resident *r = &world->residents[m->id];
      if (r->is_driven && !r->carrier) continue;
      r->stays |= round >= NSVCD__CARRY_ROUNDS;
      uint32_t carrier = nsvcd__carrier_of(crowd, m);
      if (!carrier && round == 0)
        carrier = r->joins = nsvcd__lifter_of(crowd, m, workspace, size, out);
      if (carrier != r->carrier) nsvcd__carry(crowd, m, carrier);
    }
    for (size_t k = 0; k < crowd->count; k++) {
      const nsvcd_world_mover *m = &crowd->movers[world->turns[k].mover];
      if (world->residents[m->id].carrier)
        more |= !nsvcd__may_go_along(crowd, m, workspace, size, out);
    }
  }
  for (size_t k = 0; k < crowd->count; k++) {
    nsvcd__resident *r = &world->residents[crowd->movers[k].id];
    const nsvcd_pose to = r->to;
    const nsvcd_world_mover *m = &crowd->movers[k];
    if (!r->carrier) continue;
    (void)nsvcd__world_place(crowd->world, m->id, &to, 0);
    if (!(m->how.mass > 0)) continue;
    r->slips = nsvcd__d3_sub(nsvcd__d3_load(m->velocity.linear), r->goes);
  }
}

static void nsvcd__end_carrying(const nsvcd_world *world) {
  for (uint32_t id = 1; id <= world->count; id++) {
    nsvcd__resident *r = &world->residents[id];
    r->carrier = r->joins = NSVCD_NOBODY;
    r->proven = 0;
    r->stays = 0;
    r->slips = nsvcd__d3_of(0, 0, 0);
  }
}

// Adds to a velocity, so many times, that of what carries a mover.
static void nsvcd__add_carried(const nsvcd__d3 linear, const nsvcd__d3 angular, double times,
                               nsvcd_velocity *velocity) {
  nsvcd__thing thing;
  memset(&thing, 0, sizeof thing);
  thing.linear = nsvcd__d3_fma(times, linear, nsvcd__d3_load(velocity->linear));
  thing.angular = nsvcd__d3_fma(times, angular, nsvcd__d3_load(velocity->angular));
  nsvcd__tell_velocity(&thing, velocity);
}
