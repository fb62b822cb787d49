// In: a body that moves for a frame. Out: its contacts, its speed without what points into them,
// and its way at that speed, as far as it is proven free.
//
// THE LOOP. At a pose, all contacts within twice the margin are known: what points into them is
// taken off the speed before anything is asked. So what rests asks about no way at all, and what
// slides is not stopped by what it slides on. The way that is left is asked about; where it is
// stopped, the body goes to the safe pose, and goes on with what is left of the frame from there.
//
// It comes down to a margin farther than the clearance, and leaves what is nearer than half of
// that: so a way along what it rests on is not stopped by rounding, nor by the bend of a turn.
#pragma once
#include "respond.h"

// defaults: a fraction of the body's reach; rounds; the least cosine of a ground
#define NSVCD__USUAL_CLEARANCE 0.005
#define NSVCD__USUAL_ROUNDS 4
#define NSVCD__USUAL_SLOPE 0.7
// the least cosine of an edge of a step that feet stand on
#define NSVCD__EDGE_SLOPE 0.05
// of the margin: how exact stops are
#define NSVCD__STOPS_WITHIN 0.05
// of the margin: a way in which no point goes farther is none for what rubs against something
#define NSVCD__STILL 0.05
#define NSVCD__MOST_STOPS 4
// of the energy before: more than impulses leave that have not converged
#define NSVCD__BOUNCE_ENERGY 1.001
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
  // unit, or 0; the least cosine of a ground; and whether it may be an edge of a step in this round
  nsvcd__d3 up;
  double slope;
  int is_on_edge;
  // in the frame before it was on such an edge
  int was_on_edge;
  // it was given a speed upwards
  int jumps;
  // the speed of what it rides on; and the speed besides its own with which it leaves what is near
  nsvcd__d3 ridden, leaves;
  // how high is what it stands on, or its sole, as it begins to climb
  double floor;
  // what its last way met first; or nobody
  size_t met;
  // a character's: of its speed, that is left for the rest of the frame
  double pace;
  // what has stopped it in this frame: contacts that a look may leave out, where many are; and
  // where its pivot was then
  size_t stop_count;
  nsvcd__d3 stopped_at[NSVCD__MOST_STOPS];
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

// How far a point goes with a body, from one of its poses to another.
static nsvcd__d3 nsvcd__moved_along(const nsvcd__dpose *from, const nsvcd_pose *to,
                                    nsvcd__d3 point) {
  const nsvcd__dpose end = nsvcd__dpose_of(to);
  const nsvcd__dtransform now = nsvcd__dtransform_of(from);
  const nsvcd__dtransform then = nsvcd__dtransform_of(&end);
  const nsvcd__d3 own =
      nsvcd__dmat3_apply_transpose(&now.rotation, nsvcd__d3_sub(point, now.position));
  return nsvcd__d3_sub(nsvcd__d3_transform(&then, own), point);
}

// How fast a driven body moves a point that is there now, and goes with it, on average over what is
// left of the frame.
static nsvcd__d3 nsvcd__driven_speed(const nsvcd__slide *s, size_t id, nsvcd__d3 point) {
  const nsvcd__resident *r = &s->ask.world->residents[id];
  if (!r->is_driven || !(s->left > 0)) return nsvcd__d3_of(0, 0, 0);
  const nsvcd__dpose at =
      nsvcd__dpose_between(&r->given.pose, &r->to, r->shape.pivot, 1 - s->left);
  const nsvcd__d3 moved = nsvcd__moved_along(&at, &r->to, point);
  return nsvcd__d3_scale(moved, 1 / (s->left * s->seconds));
}

// How fast what is carried slips along a contact: it has moved already, and only friction sees it.
static nsvcd__d3 nsvcd__slip_of(const nsvcd__resident *r, nsvcd__d3 normal) {
  if (!r->carrier) return nsvcd__d3_of(0, 0, 0);
  return nsvcd__d3_fma(-nsvcd__d3_dot(r->slips, normal), normal, r->slips);
}

// A contact as a body sees it whose pivot is there.
static nsvcd__hold nsvcd__hold_at(const nsvcd_contact *c, nsvcd__d3 pivot) {
  nsvcd__hold out;
  memset(&out, 0, sizeof out);
  out.normal = nsvcd__d3_load(c->normal);
  const nsvcd__d3 own = nsvcd__d3_fma((double)c->gap, out.normal, nsvcd__d3_load(c->point));
  out.arm = nsvcd__d3_sub(own, pivot);
  return out;
}

// Forgets the stops that the body, whose pivot is there now, has left.
static void nsvcd__forget_stops(nsvcd__slide *s, nsvcd__d3 pivot) {
  size_t kept = 0;
  for (size_t k = 0; k < s->stop_count; k++) {
    const nsvcd__d3 gone = nsvcd__d3_sub(pivot, s->stopped_at[k]);
    if (nsvcd__d3_dot(gone, nsvcd__d3_load(s->stops[k].contact.normal)) > s->margin) continue;
    s->stopped_at[kept] = s->stopped_at[k];
    s->stops[kept++] = s->stops[k];
  }
  s->stop_count = kept;
}

// Finds all contacts at the pose now, behind those that have pushed, and what they ask for.
static void nsvcd__slide_look(nsvcd__slide *s) {
  const nsvcd__d3 pivot = nsvcd__pivot_at(s);
  const double time = nsvcd__max(s->left, 1e-3) * s->seconds;
  const float within = (float)(s->clearance + 2 * s->margin);
  double flattest = s->is_on_edge ? NSVCD__EDGE_SLOPE : s->slope;
  size_t kept = 0;
  nsvcd__forget_stops(s, pivot);
  for (size_t k = 0; k < s->contact_count; k++) {
    if (!(s->contacts[k].impulse > 0)) continue;
    s->holds[kept] = s->holds[k];
    s->contacts[kept++] = s->contacts[k];
  }
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
    *h = nsvcd__hold_at(c, pivot);
    const nsvcd__d3 on_other = nsvcd__d3_load(c->point);
    const nsvcd__d3 driven = nsvcd__driven_speed(s, s->contacts[k].body, on_other);
    h->speed = nsvcd__d3_add(
        driven, nsvcd__slip_of(&s->ask.world->residents[s->contacts[k].body], h->normal));
    h->lacks = s->clearance + 0.5 * s->margin - (double)c->gap;
    h->least = nsvcd__min(s->clearance + s->margin - (double)c->gap, 0) / time;
    const double flat = nsvcd__d3_dot(h->normal, s->up);
    if (flat >= flattest) s->ground = &s->contacts[k];
    flattest = nsvcd__max(flattest, flat);
  }
  const size_t count = s->contact_count - s->kept;
  s->leaves = nsvcd__leaving(s->holds + s->kept, count, s->seconds);
}

// Takes off the speed what points into contacts; what comes fast bounces.
static void nsvcd__slide_respond(nsvcd__slide *s) {
  const size_t count = s->contact_count - s->kept;
  int is_driven = 0;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    nsvcd__hold *h = &s->holds[k];
    const nsvcd__d3 speed = nsvcd__d3_sub(nsvcd__speed_at(&s->thing, h->arm), h->speed);
    h->into = -nsvcd__d3_dot(speed, h->normal);
    is_driven |= s->ask.world->residents[s->contacts[k].body].is_driven;
    if (h->into > NSVCD__BOUNCES)
      h->least = nsvcd__max(h->least, (double)s->given->restitution * h->into);
  }
  const nsvcd__thing came = s->thing;
  nsvcd__respond(&s->thing, s->holds + s->kept, count, 0);
  // bounces at several contacts at once may gain energy: then none bounces
  if (s->given->restitution > 0 && !is_driven &&
      nsvcd__energy_of(&s->thing) > NSVCD__BOUNCE_ENERGY * nsvcd__energy_of(&came)) {
    s->thing = came;
    for (size_t k = s->kept; k < s->contact_count; k++) {
      nsvcd__hold *h = &s->holds[k];
      h->least = nsvcd__min(h->least, 0);
      h->pushed = 0;
      h->rubbed = nsvcd__d3_of(0, 0, 0);
    }
    nsvcd__respond(&s->thing, s->holds + s->kept, count, 0);
  }
  for (size_t k = s->kept; k < s->contact_count; k++)
    s->contacts[k].impulse = (float)s->holds[k].pushed;
}

// ---- ways

// The pose after some seconds at the speed now.
static nsvcd_pose nsvcd__aim(const nsvcd__slide *s, double seconds) {
  const nsvcd__d3 c = s->ask.shape.pivot;
  const nsvcd__d3 w = s->thing.angular;
  const double angle = nsvcd__d3_norm(w) * seconds;
  const double sine = angle > 1e-9 ? nsvcd__sin(0.5 * angle) * seconds / angle : 0.5 * seconds;
  const nsvcd__d3 u = nsvcd__d3_scale(w, sine);
  const nsvcd__dquat turn = {u.x, u.y, u.z, sqrt(nsvcd__max(1 - nsvcd__d3_dot(u, u), 0))};
  nsvcd__dpose out = nsvcd__unit_dpose(&s->pose);
  const nsvcd__d3 pivot = nsvcd__to_pivot(&out, c, 1);
  out.rotation = nsvcd__dquat_mul(turn, out.rotation);
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const nsvcd__d3 rides = nsvcd__d3_add(s->ridden, s->leaves);
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
    s->stopped_at[s->stop_count] = nsvcd__pivot_at(s);
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

// Does the body, pushed out at once, meet nothing on its way? What it is in contact with as it
// begins it leaves.
static int nsvcd__meets_nothing_else(nsvcd__asker *asked, const nsvcd_pose *way) {
  nsvcd__asker q = *asked;
  q.question.ask = NSVCD_ASK_HIT;
  q.question.clearance = q.question.to = q.question.slop = 0;
  q.at_once = 1;
  nsvcd__asker_goes(&q, way, 2);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    q.question.a.count = 2;
    if (!nsvcd__ask_for(asked, &q, id, &answer)) return 0;
    if (answer.verdict == NSVCD_FREE) continue;
    q.question.a.count = 1;
    if (!nsvcd__ask_for(asked, &q, id, &answer) || answer.verdict == NSVCD_FREE) return 0;
  }
  return 1;
}

// The body cannot go on: something is within its clearance, or about to come there. It is pushed
// out, to where it rests or else as far as it has to be, by a way on which it meets nothing.
// Returns whether it was.
static int nsvcd__push_off(nsvcd__slide *s) {
  nsvcd__asker q = s->ask;
  q.since = 1 - s->left;
  q.question.a.poses = &s->pose;
  for (int k = 0; k < 2; k++) {
    q.question.clearance = (float)(s->clearance + (k ? 0 : 0.75 * s->margin));
    q.question.slop = 2 * q.question.clearance;
    const nsvcd__d3 by = nsvcd__push_out_of_all(&q);
    const nsvcd_pose way[2] = {s->pose, nsvcd__displaced(&s->pose, by)};
    const int may_go = nsvcd__d3_dot(by, by) > 0 &&
                       nsvcd__may_be_at(&q, &way[1], 1, s->clearance, q.since, 0) &&
                       nsvcd__meets_nothing_else(&q, way);
    s->ask.questions = q.questions;
    s->ask.work = q.work;
    s->ask.result = q.result;
    if (!may_go) continue;
    s->pose = way[1];
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
  const double turn = nsvcd__d3_norm(s->thing.angular);
  const double speed =
      nsvcd__d3_norm(nsvcd__d3_add(s->thing.linear, s->leaves)) + turn * s->ask.shape.reach;
  return speed * s->left * s->seconds;
}
