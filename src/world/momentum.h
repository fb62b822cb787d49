// In: a body that has slid, and the movers that it met. Out: the speeds of all of them, each with
// its part of the momentum.
//
// A slide's impulses are those of a body that meets what rests. Where that is a mover, it takes the
// same impulse the other way, and both are then too fast apart. So, round after round, each contact
// gives back what is too much, until its two bodies leave each other as restitution has them. What
// one gains the other loses: momentum is kept, whether or not the rounds have converged. Contacts
// with all else hold what they held.
//
// Not all movers that are met take part. A body on a pile presses on it by gravity in each frame,
// and if that were handed on, nothing would come to rest: what comes no faster than two frames of
// gravity along the normal, or than twice `quiet`, holds, and so does what has stood for two
// frames, unless the normal is level. Else the crates of a stack, each of which keeps half of what
// it hands down, would do so for ever. For a character only the gravity counts, once.
//
// A slide's friction, and contacts one after the other, may leave more energy in sum than before:
// then of all changes as much is taken back, which keeps the momentum too.
#pragma once
#include "slide.h"

// of a change that would gain energy: less is none
#define NSVCD__LEAST_SHARE 0.05
// the sine of the steepest angle at which a normal is level
#define NSVCD__LEVEL_NORMAL 0.1
// relative: rounding
#define NSVCD__ENERGY_SAME 1e-6

// What is the same for all movers of a step.
typedef struct nsvcd__crowd {
  nsvcd_world *world;
  nsvcd_world_mover *movers;
  size_t count;
  float seconds;
  // what gravity adds to a speed in the frame; and against it, unit, or 0
  nsvcd__d3 falls, up;
  // metres a second, seconds
  double quiet, calm;
} nsvcd__crowd;

// The mover of a body, or NULL.
static nsvcd_world_mover *nsvcd__mover_with(const nsvcd__crowd *crowd, size_t id) {
  const nsvcd__resident *r = nsvcd__resident_of(crowd->world, id);
  nsvcd_world_mover *m = r && r->mover < crowd->count ? &crowd->movers[r->mover] : NULL;
  return m && m->id == id ? m : NULL;
}

static void nsvcd__wake(nsvcd_world_mover *m) {
  m->asleep = 0;
  m->calm = 0;
}

// A contact of the body with something, or with a mover that takes part.
typedef struct nsvcd__encounter {
  nsvcd_world_contact *contact;
  nsvcd__hold own, other;
  // of the movers that take part; or none
  size_t with;
} nsvcd__encounter;

typedef struct nsvcd__momentum {
  nsvcd__thing thing;
  // the speed of the frame in which the body slid
  nsvcd__d3 frame;
  size_t count, met_count;
  nsvcd__encounter encounters[NSVCD_WORLD_CONTACTS];
  // the movers that take part
  nsvcd_world_mover *met[NSVCD_WORLD_CONTACTS];
  nsvcd__thing things[NSVCD_WORLD_CONTACTS];
} nsvcd__momentum;

// A contact as the other body sees it.
static nsvcd__hold nsvcd__hold_of_other(const nsvcd__crowd *crowd, size_t id,
                                        const nsvcd__thing *thing,
                                        const nsvcd_contact *contact) {
  const nsvcd__resident *r = &crowd->world->residents[id];
  const nsvcd__d3 pivot = nsvcd__pivot_of(&r->given.pose, r->shape.pivot);
  nsvcd__hold out;
  memset(&out, 0, sizeof out);
  out.normal = nsvcd__d3_load(contact->normal);
  out.arm = nsvcd__d3_sub(nsvcd__d3_load(contact->point), pivot);
  out.give = nsvcd__give_of(thing, out.arm, out.normal, &out.turn);
  return out;
}

static double nsvcd__speed_along(const nsvcd__thing *thing, const nsvcd__hold *hold) {
  return nsvcd__d3_dot(nsvcd__speed_at(thing, hold->arm), hold->normal);
}

// Does a mover take part in a contact? came: the body before its slide.
static int nsvcd__takes_part(const nsvcd__crowd *crowd, const nsvcd_world_mover *m,
                             const nsvcd__thing *came, const nsvcd__encounter *at) {
  const double falls = fabs(nsvcd__d3_dot(crowd->falls, at->own.normal));
  const double least = m->how.mass > 0 ? 2 * crowd->quiet : 0;
  const double goes = -nsvcd__speed_along(came, &at->own);
  const int is_piled = m->how.mass > 0 && crowd->world->residents[m->id].stood > 1;
  if (is_piled && falls > NSVCD__LEVEL_NORMAL * nsvcd__d3_norm(crowd->falls)) return 0;
  return goes > nsvcd__max(2 * falls, least);
}

// Has any contact with a body pushed?
static int nsvcd__has_pushed(const nsvcd_slide_answer *answer, size_t body) {
  size_t k = 0;
  while (k < answer->contact_count &&
         (answer->contacts[k].body != body || !(answer->contacts[k].impulse > 0)))
    k++;
  return k < answer->contact_count;
}

// Finds the contacts with bodies that pushed in a slide, and who takes part in them. Where one
// corner of a face took all, the others are to have their part; those farther may come nearer.
static void nsvcd__momentum_begin(const nsvcd__crowd *crowd, nsvcd_world_mover *m,
                                  const nsvcd_velocity *velocity, const nsvcd__hold *holds,
                                  nsvcd__momentum *p) {
  const double mass = m->how.mass > 0 ? 1 : (double)m->push_mass;
  const nsvcd_pose *pose = &m->answer.pose;
  nsvcd__thing came = nsvcd__thing_of(&m->how, pose, velocity);
  p->thing = nsvcd__thing_of(&m->how, pose, &m->velocity);
  came.inverse_mass = p->thing.inverse_mass /= mass;
  p->thing.inverse_inertia = nsvcd__d3_over(p->thing.inverse_inertia, mass);
  p->count = p->met_count = 0;
  for (size_t k = 0; k < m->answer.contact_count; k++) {
    nsvcd_world_contact *c = &m->answer.contacts[k];
    nsvcd_world_mover *met = nsvcd__mover_with(crowd, c->body);
    nsvcd__encounter *at = &p->encounters[p->count];
    if (!nsvcd__has_pushed(&m->answer, c->body)) continue;
    at->contact = c;
    at->own = holds[k];
    at->own.give = nsvcd__give_of(&p->thing, at->own.arm, at->own.normal, &at->own.turn);
    at->own.pushed = 0;
    at->own.least = nsvcd__min(nsvcd__speed_along(&p->thing, &at->own), 0);
    at->with = NSVCD_WORLD_CONTACTS;
    p->count++;
    if (!met || !(met->how.mass > 0) || crowd->world->residents[met->id].is_driven) continue;
    if (!nsvcd__takes_part(crowd, m, &came, at)) continue;
    size_t j = 0;
    while (j < p->met_count && p->met[j] != met) j++;
    const nsvcd_pose *there = &crowd->world->residents[met->id].given.pose;
    if (j == p->met_count) {
      p->things[j] = nsvcd__thing_of(&met->how, there, &met->velocity);
      p->things[j].linear = nsvcd__d3_sub(p->things[j].linear, p->frame);
    }
    at->other = nsvcd__hold_of_other(crowd, met->id, &p->things[j], &c->contact);
    const double nears = at->own.into + nsvcd__speed_along(&p->things[j], &at->other);
    const int bounces = nears > NSVCD__BOUNCES;
    const double gap = nsvcd__max(-holds[k].lacks, 0) / (double)crowd->seconds;
    at->own.least = bounces ? (double)m->how.restitution * nears : -gap;
    at->own.pushed = -mass * holds[k].pushed * (double)m->answer.spent;
    at->with = j;
    p->met[j] = met;
    if (j == p->met_count) p->met_count++;
  }
}

// Gives those who take part their impulses, and corrects these. Returns by how much at most.
static double nsvcd__momentum_round(nsvcd__momentum *p, double *most) {
  double change = 0;
  for (size_t k = 0; k < p->count; k++) {
    nsvcd__encounter *at = &p->encounters[k];
    nsvcd__thing *other = at->with < p->met_count ? &p->things[at->with] : NULL;
    const double theirs = other ? nsvcd__speed_along(other, &at->other) : 0;
    const double lacks = at->own.least - nsvcd__speed_along(&p->thing, &at->own) + theirs;
    const double give = at->own.give + (other ? at->other.give : 0);
    const double more = nsvcd__max(lacks / give, -at->own.pushed);
    at->own.pushed += more;
    nsvcd__push(&p->thing, &at->own, more);
    if (other) nsvcd__push(other, &at->other, -more);
    change = nsvcd__max(change, fabs(more));
    *most = nsvcd__max(*most, at->own.pushed);
  }
  return change;
}

static void nsvcd__tell_velocity(const nsvcd__thing *thing, nsvcd_velocity *velocity) {
  const float most = NSVCD_MAX_COORDINATE;
  float *linear = velocity->linear;
  float *angular = velocity->angular;
  nsvcd__f3_store(nsvcd__f3_round(thing->linear), linear);
  nsvcd__f3_store(nsvcd__f3_round(thing->angular), angular);
  for (int k = 0; k < 3; k++) {
    linear[k] = fmaxf(-most, fminf(linear[k], most));
    angular[k] = fmaxf(-most, fminf(angular[k], most));
  }
}

// Joules.
static double nsvcd__energy_of_all(const nsvcd__momentum *p) {
  double out = nsvcd__energy_of(&p->thing);
  for (size_t j = 0; j < p->met_count; j++) out += nsvcd__energy_of(&p->things[j]);
  return out;
}

static void nsvcd__set_velocity(nsvcd__thing *thing, const nsvcd_velocity *velocity) {
  thing->linear = nsvcd__d3_load(velocity->linear);
  thing->angular = nsvcd__d3_load(velocity->angular);
}
// Takes a speed from what it was, in a frame, a share of the way to what it is.
static void nsvcd__share_change(nsvcd__thing *thing, const nsvcd_velocity *was,
                                nsvcd__d3 frame, double share) {
  const nsvcd__thing now = *thing;
  nsvcd__set_velocity(thing, was);
  thing->linear = nsvcd__d3_sub(thing->linear, frame);
  thing->linear = nsvcd__d3_mix(thing->linear, now.linear, share);
  thing->angular = nsvcd__d3_mix(thing->angular, now.angular, share);
}
static void nsvcd__share_all(nsvcd__momentum *p, const nsvcd_velocity *came, double share) {
  nsvcd__share_change(&p->thing, came, nsvcd__d3_of(0, 0, 0), share);
  for (size_t j = 0; j < p->met_count; j++)
    nsvcd__share_change(&p->things[j], &p->met[j]->velocity, p->frame, share);
}

// Takes all changes back as far as there is more energy than before, which is a parabola over the
// share that is left. Returns that.
static double nsvcd__gain_nothing(nsvcd__momentum *p, const nsvcd_velocity *came,
                                  double before) {
  const double after = nsvcd__energy_of_all(p);
  if (!(after > before)) return 1;
  nsvcd__share_all(p, came, 0.5);
  const double square = 2 * (before + after) - 4 * nsvcd__energy_of_all(p);
  const double share = nsvcd__max(1 - (after - before) / square, 0);
  nsvcd__share_all(p, came, 2 * share);
  return share;
}

// A body has slid, and came at a speed, in a frame that moves at another: it and what it met share
// their momentum.
static void nsvcd__share_momentum(const nsvcd__crowd *crowd, nsvcd_world_mover *m,
                                  const nsvcd_velocity *came, nsvcd__d3 frame,
                                  const nsvcd__hold *holds) {
  nsvcd__momentum p;
  double most = 0;
  double change = 1;
  const double mass = m->how.mass > 0 ? 1 : (double)m->push_mass;
  if (!(mass > 0)) return;
  p.frame = frame;
  nsvcd__momentum_begin(crowd, m, came, holds, &p);
  if (p.met_count == 0) return;
  const nsvcd__thing slid = p.thing;
  nsvcd__set_velocity(&p.thing, came);
  const double energy = (1 + NSVCD__ENERGY_SAME) * nsvcd__energy_of_all(&p);
  // what it lost with the rest of the frame it still has to give
  const double lost = 1 - (double)m->answer.spent;
  p.thing.linear = nsvcd__d3_fma(lost, p.thing.linear, slid.linear);
  p.thing.angular = nsvcd__d3_fma(lost, p.thing.angular, slid.angular);
  // what the slide gave is taken back, and found again
  for (size_t k = 0; k < p.count; k++) {
    nsvcd__hold *own = &p.encounters[k].own;
    nsvcd__push(&p.thing, own, own->pushed);
    own->pushed = 0;
  }
  for (int round = 0; round < NSVCD__IMPULSE_ROUNDS && change > NSVCD__IMPULSE_SAME * most;
       round++)
    change = nsvcd__momentum_round(&p, &most);
  const double share = nsvcd__gain_nothing(&p, came, energy);
  if (share < NSVCD__LEAST_SHARE) return;
  nsvcd__tell_velocity(&p.thing, &m->velocity);
  m->answer.rests = 0;
  for (size_t k = 0; k < p.count; k++) {
    const nsvcd__encounter *at = &p.encounters[k];
    const double held = at->with < p.met_count ? 0 : (double)at->contact->impulse;
    at->contact->impulse = (float)(held + share * at->own.pushed / mass);
  }
  for (size_t j = 0; j < p.met_count; j++) {
    p.things[j].linear = nsvcd__d3_add(p.things[j].linear, frame);
    nsvcd__tell_velocity(&p.things[j], &p.met[j]->velocity);
    if (p.met[j]->asleep) nsvcd__wake(p.met[j]);
  }
}
