// In: a body of a world, its speed and a time. Out: it is elsewhere, by a way that is proven free.
#pragma once
#include "walk.h"

static int nsvcd__is_amount(float x) {
  return nsvcd__is_finite(x) && x >= 0 && x <= 1e12f;
}

static nsvcd_result nsvcd__slide_check(const nsvcd_slide_options *o, float seconds,
                                       const nsvcd_velocity *velocity) {
  const float *up = o->up;
  const float square = up[0] * up[0] + up[1] * up[1] + up[2] * up[2];
  if (!nsvcd__is_length(o->clearance) || !nsvcd__is_length(o->margin))
    return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_amount(o->mass) || !nsvcd__is_amount(o->friction)) return NSVCD_ERROR_VALUE;
  if (!nsvcd__is_amount(o->restitution) || o->restitution > 1) return NSVCD_ERROR_VALUE;
  if (!nsvcd__is_amount(o->slope) || o->slope > 1) return NSVCD_ERROR_VALUE;
  for (size_t k = 0; k < 3; k++)
    if (!nsvcd__is_amount(o->inertia[k])) return NSVCD_ERROR_VALUE;
  if (!nsvcd__is_finite(square) || (square > 0 && fabsf(square - 1) > 1e-3f))
    return NSVCD_ERROR_AXIS;
  if (!nsvcd__is_length(o->step)) return NSVCD_ERROR_DISTANCE;
  if (!nsvcd__is_finite(seconds) || !(seconds > 0)) return NSVCD_ERROR_TIMES;
  if (!nsvcd__in_range(velocity->linear, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_SPEED;
  if (!nsvcd__in_range(velocity->angular, 3, NSVCD_MAX_COORDINATE)) return NSVCD_ERROR_SPEED;
  return NSVCD_OK;
}

// A body as contacts see it: its speed, and what an impulse changes.
static nsvcd__thing nsvcd__thing_of(const nsvcd_slide_options *given, const nsvcd_pose *pose,
                                    const nsvcd_velocity *velocity) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  const float *inertia = given->inertia;
  nsvcd__thing out;
  out.linear = nsvcd__d3_load(velocity->linear);
  out.angular = nsvcd__d3_load(velocity->angular);
  out.inverse_mass = given->mass > 0 ? 1 / (double)given->mass : 1;
  out.inverse_inertia = nsvcd__d3_of(inertia[0] > 0 ? 1 / (double)inertia[0] : 0,
                                     inertia[1] > 0 ? 1 / (double)inertia[1] : 0,
                                     inertia[2] > 0 ? 1 / (double)inertia[2] : 0);
  out.axes = nsvcd__dtransform_of(&at).rotation;
  out.friction = (double)given->friction;
  return out;
}

static double nsvcd__kept_clearance(const nsvcd_slide_options *given, double reach) {
  return given->clearance > 0 ? (double)given->clearance : NSVCD__USUAL_CLEARANCE * reach;
}

static nsvcd_result nsvcd__slide_begin(const nsvcd_world *world, size_t id,
                                       const nsvcd_slide_options *given, float seconds,
                                       void *workspace, size_t size,
                                       const nsvcd_velocity *velocity, nsvcd__slide *s) {
  nsvcd_world_question asked;
  memset(&asked, 0, sizeof asked);
  memset(s, 0, sizeof *s);
  asked.self = id;
  asked.question.ask = NSVCD_ASK_FIRST;
  asked.question.work = given->work ? given->work : NSVCD_DEFAULT_SLIDE_WORK;
  if (!nsvcd__resident_of(world, id)) return NSVCD_ERROR_INDEX;
  nsvcd_result result = nsvcd__slide_check(given, seconds, velocity);
  if (!result) result = nsvcd__asker_begin(world, &asked, workspace, size, &s->ask);
  if (result) return result;
  s->given = given;
  s->pose = world->residents[id].given.pose;
  s->clearance = nsvcd__kept_clearance(given, s->ask.shape.reach);
  s->margin = given->margin > 0 ? (double)given->margin : s->clearance;
  s->seconds = (double)seconds;
  s->left = s->pace = 1;
  s->up = nsvcd__d3_load(given->up);
  s->jumps = nsvcd__d3_dot(nsvcd__d3_load(velocity->linear), s->up) > 0;
  s->slope = given->slope > 0 ? (double)given->slope : NSVCD__USUAL_SLOPE;
  s->ask.question.clearance = (float)s->clearance;
  s->ask.question.to = (float)(NSVCD__STOPS_WITHIN * s->margin);
  s->thing = nsvcd__thing_of(given, &s->pose, velocity);
  return NSVCD_OK;
}

// Does the body, as it is, need no way at all in this frame? If it touches something, a way that
// floats do not show is none.
static int nsvcd__is_still(nsvcd__slide *s, const nsvcd_pose *to) {
  const int touches = s->contact_count > s->kept;
  const int rubs = s->thing.friction > 0 && touches;
  const double most = rubs ? NSVCD__STILL * s->margin : NSVCD__BOX_ROUNDING * s->margin;
  const int is_short =
      nsvcd__travel_left(s) <= most || (touches && !memcmp(to, &s->pose, sizeof *to));
  return is_short && !nsvcd__is_driven_near(s);
}

// Is it the answer of the body's last slide in this world, and not in one before?
static int nsvcd__is_last_slide(const nsvcd_world *world, size_t id,
                                const nsvcd_slide_answer *answer) {
  return answer->slides == world->residents[id].slides;
}

// Does it rest as it did in the frame before: is it told the same, and has nothing moved that it
// was in contact with, or that is near?
static int nsvcd__rests_again(nsvcd__slide *s, float seconds, const nsvcd_velocity *velocity,
                              const nsvcd_slide_answer *before) {
  const nsvcd_world *world = s->ask.world;
  const int is_same = before->rests && nsvcd__is_last_slide(world, s->ask.self, before) &&
                      !memcmp(&before->told, s->given, sizeof before->told) &&
                      !memcmp(&before->given, velocity, sizeof before->given) &&
                      !memcmp(&before->pose, &s->pose, sizeof before->pose) &&
                      !memcmp(&before->seconds, &seconds, sizeof seconds);
  if (!is_same) return 0;
  for (size_t k = 0; k < before->contact_count && k < NSVCD_WORLD_CONTACTS; k++) {
    const nsvcd__resident *r = nsvcd__resident_of(world, before->contacts[k].body);
    if (!r || r->moved > before->clock) return 0;
  }
  s->ask.question.tolerance = (float)(2 * s->margin);
  nsvcd__asker_goes(&s->ask, &s->pose, 1);
  s->ask.question.tolerance = 0;
  for (uint32_t id = 0; (id = nsvcd__asker_next(&s->ask, id)) != 0;) {
    const nsvcd__resident *r = &world->residents[id];
    if (r->is_driven || r->moved > before->clock) return 0;
  }
  return 1;
}

// What rests again meets again what it met before.
static void nsvcd__hold_again(const nsvcd__slide *s, const nsvcd_slide_answer *before,
                              nsvcd__hold *holds) {
  const nsvcd__d3 pivot = nsvcd__pivot_at(s);
  for (size_t k = 0; k < before->contact_count && k < NSVCD_WORLD_CONTACTS; k++) {
    nsvcd__hold *h = &holds[k];
    *h = nsvcd__hold_at(&before->contacts[k].contact, pivot);
    h->into = -nsvcd__d3_dot(nsvcd__speed_at(&s->thing, h->arm), h->normal);
    h->give = nsvcd__give_of(&s->thing, h->arm, h->normal, &h->turn);
    h->pushed = (double)before->contacts[k].impulse;
  }
}

// A round: what is in contact, the speed that is left, and the way at that speed. Returns whether
// there is to be another one.
static int nsvcd__slide_round(nsvcd__slide *s, int is_first, int *rests) {
  nsvcd__thing *thing = &s->thing;
  s->is_on_edge = 0;
  if (s->was_on_edge) nsvcd__seek_ground(s);
  if (!s->was_on_edge) nsvcd__slide_look(s);
  nsvcd__ride(s);
  const nsvcd_world_contact *before = nsvcd__step_before(s);
  if (before) {
    nsvcd__climb(s, before);
    nsvcd__ride(s);
  }
  nsvcd__stand(s);
  nsvcd__slide_respond(s);
  const double turn = nsvcd__d3_norm(thing->angular) * s->left * s->seconds;
  if (turn > NSVCD__MOST_TURN)
    thing->angular = nsvcd__d3_scale(thing->angular, NSVCD__MOST_TURN / turn);
  const nsvcd_pose to = nsvcd__aim(s, s->left * s->seconds);
  if (s->pace >= 1 && nsvcd__is_still(s, &to)) {
    thing->linear = thing->angular = nsvcd__d3_of(0, 0, 0);
    s->left = 0;
    *rests = is_first;
    return 0;
  }
  const double gone = nsvcd__go(s, &to, 0);
  if (s->ask.result || gone >= 1) return 0;
  if (gone > 0 && !nsvcd__met_driven(s)) return 1;
  return nsvcd__push_off(s) || gone > 0;
}

static void nsvcd__tell_slide(nsvcd__slide *s, nsvcd_velocity *velocity,
                              nsvcd_slide_answer *out) {
  const double used = 1 - s->lost;
  out->pose = s->pose;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(own, used)), velocity->linear);
  nsvcd__f3_store(nsvcd__f3_round(nsvcd__d3_scale(s->thing.angular, used)), velocity->angular);
  out->spent = (float)used;
  if (s->ground) {
    out->ground = s->ground->body;
    memcpy(out->ground_normal, s->ground->contact.normal, sizeof out->ground_normal);
  }
  out->contact_count = s->contact_count;
  memcpy(out->contacts, s->contacts, s->contact_count * sizeof *s->contacts);
  out->questions = s->ask.questions;
  out->work = s->ask.work;
}

// The rest of the frame goes by without the body. Which driven body comes to it then, or nobody?
static size_t nsvcd__caught_by(nsvcd__slide *s) {
  const double left = s->left;
  const nsvcd_pose stays = s->pose;
  if (!(left > 0) || s->ask.result || !nsvcd__is_driven_near(s)) return NSVCD_NOBODY;
  s->ask.of_driven = 1;
  const double free_until = nsvcd__go(s, &stays, 0);
  s->ask.of_driven = 0;
  s->pose = stays;
  s->left = left;
  return free_until < 1 ? s->met : NSVCD_NOBODY;
}

// Slides, and tells what became of each contact of the answer when the body met it.
static nsvcd_result nsvcd__slide_and_tell(nsvcd_world *world, size_t id,
                                          const nsvcd_slide_options *options, float seconds,
                                          void *workspace, size_t workspace_size,
                                          nsvcd_velocity *velocity, nsvcd_slide_answer *answer,
                                          nsvcd__hold *holds) {
  static const nsvcd_slide_options usual = {0, 0, 0, {0, 0, 0}, 0, 0, {0, 0, 0}, 0, 0, 0, 0};
  nsvcd__slide s;
  nsvcd_slide_answer out;
  if (!world || !velocity || !answer) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_slide_options *given = options ? options : &usual;
  if (world->changes & 1) return NSVCD_ERROR_WORLD;
  nsvcd_result result =
      nsvcd__slide_begin(world, id, given, seconds, workspace, workspace_size, velocity, &s);
  if (result) return result;
  memset(&out, 0, sizeof out);
  out.told = *given;
  out.given = *velocity;
  out.seconds = seconds;
  if (nsvcd__rests_again(&s, seconds, velocity, answer)) {
    nsvcd__hold_again(&s, answer, holds);
    memset(velocity, 0, sizeof *velocity);
    answer->questions = answer->work = 0;
    return NSVCD_OK;
  }
  s.was_on_edge = answer->ground && nsvcd__is_last_slide(world, id, answer) &&
                  nsvcd__d3_dot(nsvcd__d3_load(answer->ground_normal), s.up) < s.slope;
  const size_t rounds = given->rounds ? given->rounds : NSVCD__USUAL_ROUNDS;
  int more = 1;
  int stood = 0;
  for (size_t round = 0; more && s.left > 1e-4; round++) {
    // a driven body that turns is met again and again, and does not wait
    if (round >= (nsvcd__met_driven(&s) ? 4 * rounds : rounds)) break;
    more = nsvcd__slide_round(&s, round == 0, &out.rests);
    if (round == 0) stood = s.ground != NULL;
  }
  out.caught = nsvcd__caught_by(&s);
  if (stood) nsvcd__stop_climbing(&s);
  const double rises = nsvcd__d3_dot(nsvcd__d3_sub(s.thing.linear, s.ridden), s.up);
  s.lost = s.left;
  if (nsvcd__d3_dot(s.up, s.up) > 0 && !s.ask.result && !out.rests) {
    s.left = 0;
    nsvcd__slide_look(&s);
    if (stood && !s.ground && given->step > 0 && rises <= 0) nsvcd__step_down(&s);
  }
  if (s.ask.result) return s.ask.result;
  if (!out.rests) result = nsvcd_world_move(world, id, &s.pose);
  if (result) return result;
  if (!out.rests) world->residents[id].slides++;
  out.clock = world->clock;
  out.slides = world->residents[id].slides;
  nsvcd__tell_slide(&s, velocity, &out);
  memcpy(holds, s.holds, sizeof s.holds);
  *answer = out;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_slide(nsvcd_world *world, size_t id,
                                        const nsvcd_slide_options *options, float seconds,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_velocity *velocity, nsvcd_slide_answer *answer) {
  nsvcd__hold holds[NSVCD_WORLD_CONTACTS];
  return nsvcd__slide_and_tell(world, id, options, seconds, workspace, workspace_size,
                               velocity, answer, holds);
}
