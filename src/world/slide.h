// In: a body of a world, its speed and a time. Out: it is elsewhere, by a way that is proven free.
//
// THE LOOP. At a pose, all contacts within twice the margin are known: what points into them is
// taken off the speed before anything is asked. So what rests asks about no way at all, and what
// slides is not stopped by what it slides on. The way that is left is asked about; where it is
// stopped, the body goes to the safe pose, and goes on with what is left of the frame from there.
//
// It comes to rest a margin farther than the clearance: so a way along what it rests on is not
// stopped by rounding, nor by the bend of a turn.
#pragma once
#include "respond.h"

// defaults: a fraction of the body's reach; rounds; the least cosine of a ground
#define NSVCD__USUAL_CLEARANCE 0.005
#define NSVCD__USUAL_ROUNDS 4
#define NSVCD__USUAL_SLOPE 0.7
// of the margin: how exact stops are
#define NSVCD__STOPS_WITHIN 0.05
// of the margin: a way in which no point goes farther is none for what rubs against something
#define NSVCD__STILL 0.05
#define NSVCD__MOST_STOPS 4
// radians: the most that a body turns in a way
#define NSVCD__MOST_TURN 2.0

// A slide: what it is told, and what it is about now.
typedef struct nsvcd__slide {
  nsvcd__asker ask;
  const nsvcd_slide_options *given;
  nsvcd_pose pose;
  nsvcd__thing thing;
  // metres; seconds of the frame
  double clearance, margin, seconds;
  // of the frame; and what of it was of no use
  double left, lost;
  // unit, or 0; the least cosine of a ground
  nsvcd__d3 up;
  double slope;
  // the speed of what it rides on
  nsvcd__d3 ridden;
  nsvcd__thing leaves;
  // what its last way met first; or nobody
  size_t met;
  // a character's: of its speed, that is left for the rest of the frame
  double pace;
  // what has stopped it in this frame: contacts that a look may leave out, where many are
  size_t stop_count;
  nsvcd_world_contact stops[NSVCD__MOST_STOPS];
  // what pushed in rounds before, and then all that there is at the pose now
  size_t kept, contact_count;
  nsvcd_world_contact contacts[NSVCD_WORLD_CONTACTS];
  nsvcd__hold holds[NSVCD_WORLD_CONTACTS];
  // a contact on which a character stands; or none
  const nsvcd_world_contact *ground;
} nsvcd__slide;

// ---- speeds

static nsvcd__d3 nsvcd__pivot_at(const nsvcd__slide *s) {
  return nsvcd__pivot_of(&s->pose, s->ask.shape.pivot);
}

// How fast a driven body moves a point that is there now, and goes with it, on average over what is
// left of the frame.
static nsvcd__d3 nsvcd__driven_speed(const nsvcd__slide *s, size_t id, nsvcd__d3 point) {
  const nsvcd__resident *r = &s->ask.world->residents[id];
  if (!r->is_driven || !(s->left > 0)) return nsvcd__d3_of(0, 0, 0);
  const nsvcd__dpose at =
      nsvcd__dpose_between(&r->given.pose, &r->to, r->shape.pivot, 1 - s->left);
  const nsvcd__dpose end = nsvcd__dpose_of(&r->to);
  const nsvcd__dtransform now = nsvcd__dtransform_of(&at);
  const nsvcd__dtransform then = nsvcd__dtransform_of(&end);
  const nsvcd__d3 own =
      nsvcd__dmat3_apply_transpose(&now.rotation, nsvcd__d3_sub(point, now.position));
  const nsvcd__d3 moved = nsvcd__d3_sub(nsvcd__d3_transform(&then, own), point);
  return nsvcd__d3_scale(moved, 1 / (s->left * s->seconds));
}

// Finds all contacts at the pose now, behind those that have pushed, and what they ask for.
static void nsvcd__slide_look(nsvcd__slide *s) {
  const nsvcd__d3 pivot = nsvcd__pivot_at(s);
  const double time = nsvcd__max(s->left, 1e-3) * s->seconds;
  const float within = (float)(s->clearance + 2 * s->margin);
  double flattest = s->slope;
  size_t kept = 0;
  for (size_t k = 0; k < s->contact_count; k++)
    if (s->contacts[k].impulse > 0) s->contacts[kept++] = s->contacts[k];
  s->kept = kept < NSVCD_WORLD_CONTACTS / 2 ? kept : NSVCD_WORLD_CONTACTS / 2;
  const size_t room = NSVCD_WORLD_CONTACTS - s->kept - s->stop_count;
  memcpy(s->contacts + s->kept, s->stops, s->stop_count * sizeof *s->stops);
  nsvcd_world_contact *found = s->contacts + s->kept + s->stop_count;
  s->contact_count =
      s->kept + s->stop_count +
      nsvcd__contacts_at(&s->ask, &s->pose, 1 - s->left, within, room, found, room);
  s->ground = NULL;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    const nsvcd_contact *c = &s->contacts[k].contact;
    nsvcd__hold *h = &s->holds[k];
    memset(h, 0, sizeof *h);
    h->normal = nsvcd__d3_load(c->normal);
    const nsvcd__d3 on_other = nsvcd__d3_load(c->point);
    h->speed = nsvcd__driven_speed(s, s->contacts[k].body, on_other);
    h->arm = nsvcd__d3_sub(nsvcd__d3_fma((double)c->gap, h->normal, on_other), pivot);
    h->lacks = s->clearance + 0.5 * s->margin - (double)c->gap;
    h->least = nsvcd__min(s->clearance + s->margin - (double)c->gap, 0) / time;
    const double flat = nsvcd__d3_dot(h->normal, s->up);
    if (flat >= flattest) s->ground = &s->contacts[k];
    flattest = nsvcd__max(flattest, flat);
  }
  const size_t count = s->contact_count - s->kept;
  s->leaves = nsvcd__leaving(&s->thing, s->holds + s->kept, count, s->seconds);
}

// Takes off the speed what points into contacts; what comes fast bounces.
static void nsvcd__slide_respond(nsvcd__slide *s) {
  for (size_t k = s->kept; k < s->contact_count; k++) {
    nsvcd__hold *h = &s->holds[k];
    const nsvcd__d3 speed = nsvcd__d3_sub(nsvcd__speed_at(&s->thing, h->arm), h->speed);
    const double into = -nsvcd__d3_dot(speed, h->normal);
    if (into > NSVCD__BOUNCES)
      h->least = nsvcd__max(h->least, (double)s->given->restitution * into);
  }
  nsvcd__respond(&s->thing, s->holds + s->kept, s->contact_count - s->kept, 0);
  for (size_t k = s->kept; k < s->contact_count; k++)
    s->contacts[k].impulse = (float)s->holds[k].pushed;
}

// ---- ways

// The pose after some seconds at the speed now.
static nsvcd_pose nsvcd__aim(const nsvcd__slide *s, double seconds) {
  const nsvcd__d3 c = s->ask.shape.pivot;
  const nsvcd__d3 w = nsvcd__d3_add(s->thing.angular, s->leaves.angular);
  const double angle = nsvcd__d3_norm(w) * seconds;
  const double sine = angle > 1e-9 ? nsvcd__sin(0.5 * angle) * seconds / angle : 0.5 * seconds;
  const nsvcd__d3 u = nsvcd__d3_scale(w, sine);
  const nsvcd__dquat turn = {u.x, u.y, u.z, sqrt(nsvcd__max(1 - nsvcd__d3_dot(u, u), 0))};
  nsvcd__dpose out = nsvcd__unit_dpose(&s->pose);
  const nsvcd__d3 pivot = nsvcd__to_pivot(&out, c, 1);
  out.rotation = nsvcd__dquat_mul(turn, out.rotation);
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const nsvcd__d3 rides = nsvcd__d3_add(s->ridden, s->leaves.linear);
  out.position = nsvcd__d3_fma(seconds, nsvcd__d3_fma(s->pace, own, rides), pivot);
  out.position = nsvcd__to_pivot(&out, c, -1);
  return nsvcd__dpose_round(&out);
}

// Takes the body towards a pose as far as that is proven free, while the rest of the frame goes by,
// or at once. Returns how far, as a fraction.
static double nsvcd__go(nsvcd__slide *s, const nsvcd_pose *to, int at_once) {
  const nsvcd_pose way[2] = {s->pose, *to};
  s->ask.since = 1 - s->left;
  s->ask.at_once = at_once;
  nsvcd__asker_goes(&s->ask, way, 2);
  nsvcd__tally t = nsvcd__ask_all(&s->ask);
  if (t.first && !s->ask.result) nsvcd__make_safe(&s->ask, &t);
  if (s->ask.result) return 0;
  s->met = t.first;
  s->pose = t.safe;
  const float *n = t.stop.normal;
  if (t.safe_by && n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0.5f && !at_once &&
      s->stop_count < NSVCD__MOST_STOPS) {
    s->stops[s->stop_count].body = t.safe_by;
    s->stops[s->stop_count].impulse = 0;
    s->stops[s->stop_count++].contact = t.stop;
  }
  if (!at_once) s->left *= 1 - (double)t.safe_time;
  return (double)t.safe_time;
}

// At once, straight: how far, as a fraction.
static double nsvcd__go_by(nsvcd__slide *s, nsvcd__d3 by) {
  const nsvcd_pose to = nsvcd__displaced(&s->pose, by);
  return nsvcd__go(s, &to, 1);
}

// The body cannot go on: something is within its clearance, or about to come there. It is pushed
// out, to where it rests or else as far as it has to be. Returns whether it was.
static int nsvcd__push_off(nsvcd__slide *s) {
  nsvcd__asker q = s->ask;
  q.since = 1 - s->left;
  q.question.a.poses = &s->pose;
  for (int k = 0; k < 2; k++) {
    q.question.clearance = (float)(s->clearance + (k ? 0 : 0.75 * s->margin));
    q.question.slop = 2 * q.question.clearance;
    const nsvcd__d3 by = nsvcd__push_out_of_all(&q);
    const nsvcd_pose to = nsvcd__displaced(&s->pose, by);
    if (!(nsvcd__d3_dot(by, by) > 0) || !nsvcd__may_be_at(&s->ask, &to, q.since, 0)) continue;
    s->pose = to;
    return 1;
  }
  return 0;
}

// Could a driven body come to where the body is?
static int nsvcd__is_driven_near(nsvcd__slide *s) {
  nsvcd__asker_goes(&s->ask, &s->pose, 1);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&s->ask, id)) != 0;)
    if (s->ask.world->residents[id].is_driven) return 1;
  return 0;
}

// Is it a driven body that its last way met first?
static int nsvcd__met_driven(const nsvcd__slide *s) {
  return s->met != NSVCD_NOBODY && s->ask.world->residents[s->met].is_driven;
}

// How far points of the body go in the rest of the frame, at most, metres.
static double nsvcd__travel_left(const nsvcd__slide *s) {
  const nsvcd__d3 linear = nsvcd__d3_add(s->thing.linear, s->leaves.linear);
  const nsvcd__d3 angular = nsvcd__d3_add(s->thing.angular, s->leaves.angular);
  const double speed = nsvcd__d3_norm(linear) + nsvcd__d3_norm(angular) * s->ask.shape.reach;
  return speed * s->left * s->seconds;
}

// ---- a character

static nsvcd__d3 nsvcd__flat_part(const nsvcd__slide *s, nsvcd__d3 a) {
  return nsvcd__d3_fma(-nsvcd__d3_dot(a, s->up), s->up, a);
}

// What is too steep to stand on is a wall. For whoever stands it is upright; who is in the air
// slides down it, but does not rise by walking into it.
static void nsvcd__meet_walls(nsvcd__slide *s) {
  for (size_t k = s->kept; k < s->contact_count; k++) {
    nsvcd__hold *h = &s->holds[k];
    const double rise = nsvcd__d3_dot(h->normal, s->up);
    if (!(rise > 0) || rise >= s->slope) continue;
    const nsvcd__d3 flat = nsvcd__flat_part(s, h->normal);
    const nsvcd__d3 away = nsvcd__d3_scale(flat, 1 / nsvcd__d3_norm(flat));
    const double into = nsvcd__d3_dot(nsvcd__d3_sub(h->speed, s->thing.linear), away);
    if (s->ground) h->normal = away;
    if (!s->ground && into > 0) s->thing.linear = nsvcd__d3_fma(into, away, s->thing.linear);
  }
}

// Whoever stands on a ground does not slide down it, and walks up it as fast as on the level.
static void nsvcd__stand(nsvcd__slide *s) {
  if (s->ground) {
    const nsvcd__d3 n = nsvcd__d3_load(s->ground->contact.normal);
    const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
    const int falls = nsvcd__d3_dot(own, s->up) < 0;
    const double steep = nsvcd__d3_dot(n, s->up);
    nsvcd__d3 walks = falls ? nsvcd__flat_part(s, own) : own;
    const double into = -nsvcd__d3_dot(walks, n);
    if (into > 0) walks = nsvcd__d3_fma(into / steep, s->up, walks);
    // down to where it rests, if that is lower
    const double least = falls ? s->holds[s->ground - s->contacts].least / steep : 0;
    s->thing.linear = nsvcd__d3_add(nsvcd__d3_fma(least, s->up, walks), s->ridden);
  }
  nsvcd__meet_walls(s);
}

// Onto a step: up, along, and down again. What has been gone of the way is not gone again. Returns
// whether that led onto ground.
static int nsvcd__climb(nsvcd__slide *s) {
  const double step = (double)s->given->step;
  const nsvcd_pose start = s->pose;
  const double time = s->left * s->seconds * s->pace;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const nsvcd__d3 way = nsvcd__d3_scale(nsvcd__flat_part(s, own), time);
  const double risen = step * nsvcd__go_by(s, nsvcd__d3_scale(s->up, step));
  const double gone = nsvcd__go_by(s, way);
  const double drop = risen + s->margin;
  const double dropped = drop * nsvcd__go_by(s, nsvcd__d3_scale(s->up, -drop));
  const int is_higher = dropped < risen - s->margin && gone > 0;
  if (is_higher) nsvcd__slide_look(s);
  if (is_higher && s->ground) {
    s->pace *= 1 - gone;
    return 1;
  }
  s->pose = start;
  if (is_higher) nsvcd__slide_look(s);
  return 0;
}

// Whoever stood on a ground and walked off it steps down, if there is a ground to step down on.
static void nsvcd__step_down(nsvcd__slide *s) {
  const nsvcd_pose above = s->pose;
  if (nsvcd__go_by(s, nsvcd__d3_scale(s->up, -(double)s->given->step)) < 1) {
    nsvcd__slide_look(s);
    if (s->ground) return;
  }
  s->pose = above;
}

// Is there something too steep to stand on in the way of whoever stands?
static int nsvcd__is_before_step(const nsvcd__slide *s) {
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  if (!s->ground || !(s->given->step > 0)) return 0;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    const nsvcd__d3 n = s->holds[k].normal;
    const double rise = nsvcd__d3_dot(n, s->up);
    const double into = -nsvcd__d3_dot(walks, n);
    if (rise > -0.01 && rise < s->slope && into > 0.05 * nsvcd__d3_norm(walks)) return 1;
  }
  return 0;
}

// ---- a frame

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

static nsvcd_result nsvcd__slide_begin(const nsvcd_world *world, size_t id,
                                       const nsvcd_slide_options *given, float seconds,
                                       void *workspace, size_t size,
                                       const nsvcd_velocity *velocity, nsvcd__slide *s) {
  nsvcd_world_question asked;
  memset(&asked, 0, sizeof asked);
  memset(s, 0, sizeof *s);
  asked.self = id;
  asked.question.ask = NSVCD_ASK_FIRST;
  asked.question.work = given->work;
  if (!nsvcd__resident_of(world, id)) return NSVCD_ERROR_INDEX;
  nsvcd_result result = nsvcd__slide_check(given, seconds, velocity);
  if (!result) result = nsvcd__asker_begin(world, &asked, workspace, size, &s->ask);
  if (result) return result;
  const double usual = NSVCD__USUAL_CLEARANCE * s->ask.shape.reach;
  s->given = given;
  s->pose = world->residents[id].given.pose;
  s->clearance = given->clearance > 0 ? (double)given->clearance : usual;
  s->margin = given->margin > 0 ? (double)given->margin : s->clearance;
  s->seconds = (double)seconds;
  s->left = s->pace = 1;
  s->up = nsvcd__d3_load(given->up);
  s->slope = given->slope > 0 ? (double)given->slope : NSVCD__USUAL_SLOPE;
  s->ask.question.clearance = (float)s->clearance;
  s->ask.question.to = (float)(NSVCD__STOPS_WITHIN * s->margin);
  nsvcd__thing *thing = &s->thing;
  const nsvcd__dpose pose = nsvcd__dpose_of(&s->pose);
  const float *inertia = given->inertia;
  thing->linear = nsvcd__d3_load(velocity->linear);
  thing->angular = nsvcd__d3_load(velocity->angular);
  thing->inverse_mass = given->mass > 0 ? 1 / (double)given->mass : 1;
  thing->inverse_inertia = nsvcd__d3_of(inertia[0] > 0 ? 1 / (double)inertia[0] : 0,
                                        inertia[1] > 0 ? 1 / (double)inertia[1] : 0,
                                        inertia[2] > 0 ? 1 / (double)inertia[2] : 0);
  thing->axes = nsvcd__dtransform_of(&pose).rotation;
  thing->friction = (double)given->friction;
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

// Does it rest as it did in the frame before: is it told the same, and has nothing moved that it
// was in contact with, or that is near?
static int nsvcd__rests_again(nsvcd__slide *s, float seconds, const nsvcd_velocity *velocity,
                              const nsvcd_slide_answer *before) {
  const nsvcd_world *world = s->ask.world;
  const int is_same = before->rests && !memcmp(&before->told, s->given, sizeof before->told) &&
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

// A round: what is in contact, the speed that is left, and the way at that speed. Returns whether
// there is to be another one.
static int nsvcd__slide_round(nsvcd__slide *s, int is_first, int *rests) {
  nsvcd__thing *thing = &s->thing;
  nsvcd__slide_look(s);
  if (s->ground) {
    const nsvcd__d3 before = s->ridden;
    s->ridden = nsvcd__driven_speed(s, s->ground->body, nsvcd__pivot_at(s));
    thing->linear = nsvcd__d3_add(thing->linear, nsvcd__d3_sub(s->ridden, before));
  }
  if (nsvcd__is_before_step(s)) (void)nsvcd__climb(s);
  nsvcd__stand(s);
  nsvcd__slide_respond(s);
  const double turn = nsvcd__d3_norm(thing->angular) * s->left * s->seconds;
  if (turn > NSVCD__MOST_TURN)
    thing->angular = nsvcd__d3_scale(thing->angular, NSVCD__MOST_TURN / turn);
  const nsvcd_pose to = nsvcd__aim(s, s->left * s->seconds);
  if (nsvcd__is_still(s, &to)) {
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

NSVCDDEF nsvcd_result nsvcd_world_slide(nsvcd_world *world, size_t id,
                                        const nsvcd_slide_options *options, float seconds,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_velocity *velocity, nsvcd_slide_answer *answer) {
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
    memset(velocity, 0, sizeof *velocity);
    answer->questions = answer->work = 0;
    return NSVCD_OK;
  }
  const size_t rounds = given->rounds ? given->rounds : NSVCD__USUAL_ROUNDS;
  int more = 1;
  int stood = 0;
  for (size_t round = 0; more && s.left > 1e-4; round++) {
    // a driven body that turns is met again and again, and does not wait
    if (round >= (nsvcd__met_driven(&s) ? 4 * rounds : rounds)) break;
    more = nsvcd__slide_round(&s, round == 0, &out.rests);
    if (round == 0) stood = s.ground != NULL;
  }
  if (s.left > 0 && !s.ask.result && nsvcd__is_driven_near(&s)) {
    // the rest of the frame goes by without it
    const double left = s.left;
    const nsvcd_pose stays = s.pose;
    const double free_until = nsvcd__go(&s, &stays, 0);
    s.pose = stays;
    s.left = left;
    if (free_until < 1) out.caught = s.met;
  }
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
  out.clock = world->clock;
  nsvcd__tell_slide(&s, velocity, &out);
  *answer = out;
  return NSVCD_OK;
}
