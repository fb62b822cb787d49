// In: a question about a mover and all that it comes near. Out: one answer.
//
// Each body that is near is asked about by itself. The earliest of their times is the answer's, and
// up to there all of them are free. The pose at that time, as it is in floats, may be off the way
// by a few units of their last place: so it is asked about once more, of the others.
//
// With a slop each body's answer has a push-out of its own. One that is as long along each of these
// as that one is deep satisfies all, and nearly the shortest is found by projections (Agmon 1954).
// The way displaced by it is then asked about without a slop: what is proven is proven of that way.
#pragma once
#include "../interface/contacts.h"
#include "world.h"

// bodies whose push-outs are joined, at most
#define NSVCD__MOST_TOUCHED 32
// how often the safe pose moves back, each time twice as far
#define NSVCD__BACK 8

// Someone who asks: the mover, where it goes, and memory.
typedef struct nsvcd__asker {
  const nsvcd_world *world;
  // whose b is filled in for each body
  nsvcd_question question;
  size_t self;
  uint32_t groups, passes;
  int with_sensors;
  // 1: of bodies that are driven alone
  int of_driven;
  nsvcd__shape_box shape;
  // what its way may come near, and how near, metres
  nsvcd__box box;
  double apart;
  // driven bodies are asked about from this part of the frame on, as is the mover; or only then
  double since;
  int at_once;
  nsvcd_pose driven[2];
  void *workspace;
  size_t workspace_size;
  size_t questions, work;
  nsvcd_result result;
} nsvcd__asker;

// Turns to other poses of the mover.
static void nsvcd__asker_goes(nsvcd__asker *q, const nsvcd_pose *poses, size_t count) {
  q->apart =
      (double)q->question.clearance + (double)q->question.tolerance + (double)q->question.slop;
  q->question.a.poses = poses;
  q->question.a.count = count;
  q->box = nsvcd__box_of_way(&q->shape, poses, count, q->apart);
}

// Where a body is in the part of the frame that is asked about: writes its poses and how many.
static void nsvcd__asker_sees(nsvcd__asker *q, const nsvcd__resident *r, nsvcd_mover *mover) {
  *mover = nsvcd__mover_of(r);
  if (!r->is_driven) return;
  q->driven[0] = r->given.pose;
  q->driven[1] = r->to;
  if (q->since > 0) {
    const nsvcd__dpose at =
        nsvcd__dpose_between(&r->given.pose, &r->to, r->shape.pivot, q->since);
    q->driven[0] = nsvcd__dpose_round(&at);
  }
  mover->poses = q->driven;
  mover->count = q->at_once ? 1 : 2;
}

// May the mover, whose box meets that of a body, meet the body, as boxes in the frames of both
// tell? Where it turns half around, rounding decides which way.
static int nsvcd__asker_may_meet(const nsvcd__asker *q, const nsvcd__resident *r) {
  const nsvcd_mover *a = &q->question.a;
  const nsvcd_pose *at = &r->given.pose;
  if (r->is_driven || a->count > 2 || nsvcd__is_half_turn(a->poses, a->count)) return 1;
  return nsvcd__boxes_meet_in(at, &q->shape, a->poses, a->count, q->apart, &r->shape, at) &&
         nsvcd__boxes_meet_in(&a->poses[0], &q->shape, a->poses, a->count, q->apart, &r->shape,
                              at);
}

// The next body that the mover may meet after body `at`, or the first if that is 0; 0: none.
static uint32_t nsvcd__asker_next(const nsvcd__asker *q, uint32_t at) {
  const nsvcd_world *world = q->world;
  while ((at = nsvcd__tree_next(&world->tree, at, &q->box)) != 0) {
    const nsvcd__resident *r = &world->residents[at];
    if (at == q->self || (r->given.sensor && !q->with_sensors)) continue;
    if (q->of_driven && !r->is_driven) continue;
    if (!nsvcd__groups_meet(q->groups, q->passes, &r->given)) continue;
    if (nsvcd__boxes_meet(&q->box, &r->box) && nsvcd__asker_may_meet(q, r)) return at;
  }
  return 0;
}

// Asks about one body. 0: it was refused.
static int nsvcd__ask_about(nsvcd__asker *q, uint32_t id, nsvcd_answer *answer) {
  nsvcd__asker_sees(q, &q->world->residents[id], &q->question.b);
  if (!q->result)
    q->result = nsvcd_sweep(&q->question, q->workspace, q->workspace_size, answer);
  if (q->result) return 0;
  q->questions++;
  q->work += answer->work;
  return 1;
}

// The same by a copy of an asker that asks something else: the question counts as the asker's.
static int nsvcd__ask_for(nsvcd__asker *asked, nsvcd__asker *copy, uint32_t id,
                          nsvcd_answer *answer) {
  const int is_answered = nsvcd__ask_about(copy, id, answer);
  asked->questions = copy->questions;
  asked->work = copy->work;
  asked->result = copy->result;
  return is_answered;
}

// Makes a question an asker's. The mover may be without poses: then it is where it is in the world.
static nsvcd_result nsvcd__asker_begin(const nsvcd_world *world,
                                       const nsvcd_world_question *asked, void *workspace,
                                       size_t size, nsvcd__asker *q) {
  static const nsvcd_pose origin = {{0, 0, 0}, {0, 0, 0, 1}};
  static const nsvcd_pose elsewhere = {{1, 0, 0}, {0, 0, 0, 1}};
  const nsvcd_question *given = &asked->question;
  const nsvcd__resident *self = nsvcd__resident_of(world, asked->self);
  memset(q, 0, sizeof *q);
  if (asked->self != NSVCD_NOBODY && !self) return NSVCD_ERROR_INDEX;
  if (given->b.body || given->b.poses || (!self && !given->a.body))
    return NSVCD_ERROR_ARGUMENT;
  if (given->method != NSVCD_METHOD_DEFAULT && given->method != NSVCD_METHOD_PROOF)
    return NSVCD_ERROR_METHOD;
  q->world = world;
  q->question = *given;
  q->question.method = NSVCD_METHOD_PROOF;
  q->self = asked->self;
  q->groups = self ? self->given.groups : asked->groups ? asked->groups : 1;
  q->passes = self ? self->given.passes : asked->passes;
  q->workspace = workspace;
  q->workspace_size = size;
  nsvcd_mover *a = &q->question.a;
  if (self && !a->body) {
    const nsvcd_mover mover = nsvcd__mover_of(self);
    a->body = mover.body;
    a->scale = mover.scale;
    memcpy(a->pivot, mover.pivot, sizeof a->pivot);
  }
  if (!a->poses && a->count == 0) {
    a->poses = self ? &self->given.pose : &origin;
    a->count = 1;
  }
  // Is the question in order? Beside any other body it would be answered, with a workspace.
  nsvcd_question probe = q->question;
  nsvcd_answer unused;
  probe.b.body = a->body;
  probe.b.poses = &elsewhere;
  probe.b.count = 1;
  const nsvcd_result result = nsvcd_sweep(&probe, NULL, 0, &unused);
  if (result != NSVCD_ERROR_WORKSPACE) return result;
  if (!workspace || size < nsvcd_sweep_workspace_size(NULL)) return result;
  q->shape = nsvcd__shape_box_of(a);
  nsvcd__asker_goes(q, a->poses, a->count);
  return NSVCD_OK;
}

// ---- what is known of all bodies so far

typedef struct nsvcd__tally {
  int is_hit, is_undecided;
  nsvcd_why why;
  nsvcd_range time;
  // which is hit, or undecided, first
  size_t first;
  // the body whose safe pose is the earliest, and that
  size_t safe_by;
  float safe_time;
  nsvcd_pose safe;
  // the contact that this body stops it at, if it has a normal
  nsvcd_contact stop;
} nsvcd__tally;

static nsvcd__tally nsvcd__tally_of(const nsvcd__asker *q) {
  const nsvcd_mover *a = &q->question.a;
  nsvcd__tally out;
  memset(&out, 0, sizeof out);
  out.time.low = out.time.high = out.safe_time = 1;
  out.safe = a->poses[a->count - 1];
  return out;
}

// Is an answer about a contact, or something undecided, that comes before what is known?
static int nsvcd__comes_first(const nsvcd__tally *t, const nsvcd_answer *answer) {
  const int is_hit = answer->verdict == NSVCD_HIT;
  if (is_hit != t->is_hit) return is_hit;
  return is_hit ? answer->time.high < t->time.high : answer->time.low < t->time.low;
}

static void nsvcd__tally_add(nsvcd__tally *t, size_t id, const nsvcd_answer *answer) {
  if (answer->verdict == NSVCD_FREE) return;
  if (!t->first || nsvcd__comes_first(t, answer)) t->first = id;
  if (answer->verdict == NSVCD_HIT) {
    t->time.high = t->is_hit ? fminf(t->time.high, answer->time.high) : answer->time.high;
    t->is_hit = 1;
  } else {
    t->is_undecided = 1;
    if (!t->is_hit) t->time.high = HUGE_VALF;
  }
  if (!t->why) t->why = answer->why;
  t->time.low = fminf(t->time.low, answer->time.low);
  if (t->safe_by && answer->safe.time >= t->safe_time) return;
  t->safe_by = id;
  t->safe_time = answer->safe.time;
  t->safe = answer->safe.a;
  t->stop = answer->nearest;
}

// Asks about all bodies; HIT only until one is hit.
static nsvcd__tally nsvcd__ask_all(nsvcd__asker *q) {
  nsvcd__tally t = nsvcd__tally_of(q);
  for (uint32_t id = 0; (id = nsvcd__asker_next(q, id)) != 0;) {
    nsvcd_answer answer;
    if (!nsvcd__ask_about(q, id, &answer)) return t;
    nsvcd__tally_add(&t, id, &answer);
    if (t.is_hit && q->question.ask == NSVCD_ASK_HIT) break;
  }
  return t;
}

// ---- one push-out of all

// Nearly the shortest push-out that is so long along each normal; 0 if none is found.
static nsvcd__d3 nsvcd__join_push_outs(const nsvcd__d3 *normals, const double *depths,
                                       size_t count) {
  nsvcd__d3 out = {0, 0, 0};
  for (int round = 0; round < 64; round++) {
    double most = 0;
    for (size_t k = 0; k < count; k++) {
      const double lacks = depths[k] - nsvcd__d3_dot(out, normals[k]);
      if (!(lacks > 0)) continue;
      most = nsvcd__max(most, lacks / depths[k]);
      out = nsvcd__d3_fma(lacks, normals[k], out);
    }
    if (most <= 0.01) return out;
  }
  return nsvcd__d3_of(0, 0, 0);
}

// The push-out of the mover out of all that it touches at the start, by the question's slop: twice
// that at most, or 0 if there is none.
static nsvcd__d3 nsvcd__push_out_of_all(nsvcd__asker *asked) {
  nsvcd__asker q = *asked;
  nsvcd__d3 normals[NSVCD__MOST_TOUCHED];
  double depths[NSVCD__MOST_TOUCHED];
  size_t count = 0;
  const nsvcd__d3 none = {0, 0, 0};
  const float slop = q.question.slop;
  q.at_once = 1;
  q.question.a.times = NULL;
  nsvcd__asker_goes(&q, q.question.a.poses, 1);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    if (!nsvcd__ask_for(asked, &q, id, &answer)) return none;
    const nsvcd__d3 push_out = nsvcd__d3_load(answer.push_out);
    const double length = nsvcd__d3_norm(push_out);
    if (answer.depth > slop || count == NSVCD__MOST_TOUCHED) return none;
    if (!(length > 0)) continue;
    normals[count] = nsvcd__d3_scale(push_out, 1 / length);
    depths[count++] = (double)answer.depth + 0.05 * (double)slop;
  }
  const nsvcd__d3 out = nsvcd__join_push_outs(normals, depths, count);
  return nsvcd__d3_norm(out) <= 2 * (double)slop ? out : none;
}

// ---- where the mover may go

// A pose displaced, as it is in floats.
static nsvcd_pose nsvcd__displaced(const nsvcd_pose *pose, nsvcd__d3 by) {
  nsvcd_pose out = *pose;
  const nsvcd__d3 at = nsvcd__d3_add(nsvcd__d3_load(pose->position), by);
  nsvcd__f3_store(nsvcd__f3_round(at), out.position);
  return out;
}

// The pose of a way at a time in [0,1].
static nsvcd_pose nsvcd__pose_on_way(const nsvcd_mover *way, const nsvcd__d3 pivot, double t) {
  const double all = (double)(way->count - 1);
  size_t k = 1;
  if (way->count == 1 || !(t > 0)) return way->poses[0];
  while (k + 1 < way->count && (way->times ? (double)way->times[k] : (double)k / all) < t) k++;
  const double from = way->times ? (double)way->times[k - 1] : (double)(k - 1) / all;
  const double to = way->times ? (double)way->times[k] : (double)k / all;
  const nsvcd__dpose at = nsvcd__dpose_between(&way->poses[k - 1], &way->poses[k], pivot,
                                               nsvcd__min((t - from) / (to - from), 1));
  return nsvcd__dpose_round(&at);
}

// Is the mover free at a pose, or on a way that it goes at once, at a part of the frame, of all
// bodies but one?
static int nsvcd__may_be_at(nsvcd__asker *asked, const nsvcd_pose *way, size_t count,
                            double clearance, double when, size_t but) {
  nsvcd__asker q = *asked;
  q.since = when;
  q.at_once = 1;
  q.question.ask = NSVCD_ASK_HIT;
  q.question.clearance = (float)clearance;
  q.question.to = q.question.to_time = q.question.slop = 0;
  q.question.manifold = 0;
  q.question.a.times = NULL;
  nsvcd__asker_goes(&q, way, count);
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    if (id == but) continue;
    if (!nsvcd__ask_for(asked, &q, id, &answer) || answer.verdict != NSVCD_FREE) return 0;
  }
  return 1;
}

// Moves the safe pose back until it is proven to be free of all as it is in floats.
static void nsvcd__make_safe(nsvcd__asker *q, nsvcd__tally *t) {
  const double clearance = (double)q->question.clearance;
  const nsvcd_mover *way = &q->question.a;
  const nsvcd__f3 size = nsvcd__f3_sub(q->box.high, q->box.low);
  const nsvcd__f3 most = nsvcd__f3_max(q->box.high, nsvcd__f3_scale(q->box.low, -1));
  const double ulps = 1e-6 * (double)nsvcd__f3_norm(most);
  double back = nsvcd__max(1e-6, ulps / (double)nsvcd__f3_norm(size));
  size_t but = t->safe_by;
  for (int k = 0; k < NSVCD__BACK && t->safe_time > 0; k++) {
    const double when = q->since + (double)t->safe_time * (1 - q->since);
    if (nsvcd__may_be_at(q, &t->safe, 1, clearance, when, but)) return;
    t->safe_time = (float)nsvcd__max((double)t->safe_time - back, 0);
    t->safe = nsvcd__pose_on_way(way, q->shape.pivot, (double)t->safe_time);
    back *= 2;
    but = 0;
  }
  t->safe_time = 0;
  t->safe = way->poses[0];
}

// Finds the contacts of the mover, at a pose and at a part of the frame, with all bodies that are
// nearer than `within` metres: `each` of every one, and `most` in all. Returns how many.
static size_t nsvcd__contacts_at(nsvcd__asker *asked, const nsvcd_pose *pose, double when,
                                 float within, size_t each, nsvcd_world_contact *contacts,
                                 size_t most) {
  nsvcd__asker q = *asked;
  size_t count = 0;
  memset(&q.question, 0, sizeof q.question);
  q.question.a = asked->question.a;
  q.question.a.times = NULL;
  q.question.work = asked->question.work;
  q.question.clearance = within;
  q.since = when;
  q.at_once = 1;
  nsvcd__asker_goes(&q, pose, 1);
  for (uint32_t id = 0; count < most && (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_contact found[NSVCD_WORLD_CONTACTS];
    const size_t room = most - count < each ? most - count : each;
    size_t n = 0;
    nsvcd__asker_sees(&q, &q.world->residents[id], &q.question.b);
    if (!q.result)
      q.result =
          nsvcd_contacts(&q.question, q.workspace, q.workspace_size, found, room, &n, NULL);
    if (q.result) break;
    q.questions++;
    for (size_t k = 0; k < n; k++) {
      nsvcd_world_contact *c = &contacts[count++];
      memset(c, 0, sizeof *c);
      c->body = id;
      c->contact = found[k];
    }
  }
  asked->result = q.result;
  asked->questions = q.questions;
  return count;
}

// ---- the answer

// poses that are displaced by a push-out, at most
#define NSVCD__DISPLACED 64

static void nsvcd__tell_all(nsvcd__asker *q, const nsvcd__tally *t, int each,
                            nsvcd_world_answer *out) {
  const nsvcd_question *asked = &q->question;
  const double usual = (double)NSVCD_DEFAULT_TO * q->shape.reach;
  const double to = asked->to > 0 ? (double)asked->to : usual;
  out->verdict = t->is_hit ? NSVCD_HIT : t->is_undecided ? NSVCD_UNDECIDED : NSVCD_FREE;
  out->why = t->why;
  out->body = t->first;
  out->time = t->time;
  out->safe_time = t->safe_time;
  out->safe = t->safe;
  if (asked->ask == NSVCD_ASK_FIRST && t->is_hit) {
    const double when = q->since + (double)t->safe_time * (1 - q->since);
    const float within = asked->clearance + (float)(2 * to);
    out->contact_count =
        nsvcd__contacts_at(q, &t->safe, when, within, each ? NSVCD_WORLD_CONTACTS : 1,
                           out->contacts, NSVCD_WORLD_CONTACTS);
  }
  out->questions = q->questions;
  out->work = q->work;
}

NSVCDDEF nsvcd_result nsvcd_world_sweep(const nsvcd_world *world,
                                        const nsvcd_world_question *question, void *workspace,
                                        size_t workspace_size, nsvcd_world_answer *answer) {
  nsvcd__asker q;
  nsvcd_pose displaced[NSVCD__DISPLACED];
  nsvcd_world_answer out;
  if (!world || !question || !answer) return NSVCD_ERROR_ARGUMENT;
  const uint32_t changes = world->changes;
  const int manifold = question->question.manifold;
  nsvcd_result result = nsvcd__asker_begin(world, question, workspace, workspace_size, &q);
  if (result) return result;
  if (q.question.ask == NSVCD_ASK_DISTANCE) return NSVCD_ERROR_ASK;
  memset(&out, 0, sizeof out);
  q.question.manifold = 0;
  if (q.question.slop > 0) {
    const size_t count = q.question.a.count;
    if (count > NSVCD__DISPLACED) return NSVCD_ERROR_POSES;
    const nsvcd__d3 by = nsvcd__push_out_of_all(&q);
    for (size_t k = 0; k < count; k++)
      displaced[k] = nsvcd__displaced(&q.question.a.poses[k], by);
    nsvcd__f3_store(nsvcd__f3_round(by), out.push_out);
    out.depth = (float)nsvcd__d3_norm(by);
    q.question.slop = 0;
    nsvcd__asker_goes(&q, displaced, count);
  }
  nsvcd__tally t = nsvcd__ask_all(&q);
  if (q.question.ask == NSVCD_ASK_FIRST && t.first) nsvcd__make_safe(&q, &t);
  nsvcd__tell_all(&q, &t, manifold, &out);
  if ((changes & 1) || changes != world->changes) return NSVCD_ERROR_WORLD;
  if (q.result) return q.result;
  *answer = out;
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_world_list(const nsvcd_world *world,
                                       const nsvcd_world_question *question, void *workspace,
                                       size_t workspace_size, size_t *ids, size_t most,
                                       size_t *count) {
  nsvcd__asker q;
  size_t found = 0;
  if (!world || !question || !count || (most > 0 && !ids)) return NSVCD_ERROR_ARGUMENT;
  const uint32_t changes = world->changes;
  const nsvcd_result result =
      nsvcd__asker_begin(world, question, workspace, workspace_size, &q);
  if (result) return result;
  if (q.question.ask != NSVCD_ASK_HIT) return NSVCD_ERROR_ASK;
  q.with_sensors = 1;
  for (uint32_t id = 0; (id = nsvcd__asker_next(&q, id)) != 0;) {
    nsvcd_answer answer;
    if (!nsvcd__ask_about(&q, id, &answer)) return q.result;
    if (answer.verdict == NSVCD_FREE) continue;
    size_t at = found < most ? found : most;  // sorted, of those the lowest
    for (; at > 0 && ids[at - 1] > id; at--)
      if (at < most) ids[at] = ids[at - 1];
    if (at < most) ids[at] = id;
    found++;
  }
  if ((changes & 1) || changes != world->changes) return NSVCD_ERROR_WORLD;
  *count = found;
  return NSVCD_OK;
}
