// In: a task. Out: its answer, by proof, with the contact as places in the world.
#pragma once
#include "../proof/leave.h"
#include "task.h"

#ifndef NSVCD_NO_PROOF
// From the fixed body's frame and units to the world, at time t.
typedef struct nsvcd__to_world {
  nsvcd__dmat3 rotation;
  nsvcd__d3 position;
  double unit;
} nsvcd__to_world;

static nsvcd__to_world nsvcd__to_world_at(const nsvcd__motion *motion, double t) {
  nsvcd__to_world out;
  nsvcd__d3 ends[2];
  double u;
  const uint32_t first = nsvcd__arc_and_share(motion, t * (double)motion->ticks, &u);
  nsvcd__leg leg;
  nsvcd__leg_init(&motion->fixed, first, nsvcd__next_knot(motion, first) - first, &leg, ends);
  out.rotation = nsvcd__dmat3_of(nsvcd__leg_at(&leg, u));
  out.position = nsvcd__d3_mix(ends[0], ends[1], u);
  out.unit = (double)motion->unit;
  return out;
}

// Makes the proof ready for a question whose motion has been prepared.
static void nsvcd__proof_begin(nsvcd__query *query) {
  const nsvcd__task *task = &query->task;
  const nsvcd_sweep_options *o = task->options;
  const float unit = task->motion.unit;
  nsvcd__proof *p = query->proof;
  p->spans = query->spans;
  p->ask.motion = &query->task.motion;
  p->moving = nsvcd__facets_of(nsvcd__triangles_of(task->moving));
  p->fixed = nsvcd__facets_of(nsvcd__triangles_of(task->fixed));
  p->given.lengths = task->motion.scale * p->moving.body->extent + p->fixed.body->extent;
  p->given.tolerance = (double)(o->tolerance / unit);
  p->given.clearance = p->ask.clearance = (double)(o->clearance / unit);
  p->given.skin = (double)(o->skin / unit);
  p->given.share = p->ask.share = (double)o->first;
  p->given.work = p->ask.limit = o->work ? o->work : NSVCD_DEFAULT_WORK;
  p->given.tells = o->first > 0 || o->measure / unit > 0 || o->skin / unit > 0;
  p->ask.measure = p->ask.first = p->low = 0;
  p->high = HUGE_VAL;
  p->work = 0;
  p->ask.gathers = p->ask.is_brief = p->within = p->unclear = 0;
  nsvcd__proof_restart(p);
}

// Answers with the contact that a proof has found: when, where, and of what. swapped: it is the
// fixed body that counts as lifted, the other way.
static void nsvcd__answer_with_contact(const nsvcd__proof *p, int swapped,
                                       nsvcd_answer *answer) {
  const nsvcd__contact *found = &p->known.found;
  const int rests = p->ask.motion->moving.count == 1 && !p->ask.motion->fixed_moves;
  const double time = rests ? 0 : found->tick / (double)p->ask.motion->ticks;
  const nsvcd__to_world world = nsvcd__to_world_at(p->ask.motion, time);
  const nsvcd__d3 lift = nsvcd__d3_scale(nsvcd__d3_widen(p->ask.motion->lift), swapped);
  const nsvcd__d3 seen = nsvcd__d3_scale(nsvcd__d3_sub(found->point, lift), world.unit);
  const nsvcd__d3 point =
      nsvcd__d3_add(nsvcd__dmat3_apply(&world.rotation, seen), world.position);
  const nsvcd__d3 normal = nsvcd__dmat3_apply(&world.rotation, found->normal);
  answer->contact_time = (float)time;
  answer->patch_a = found->moving_patch;
  answer->patch_b = found->fixed_patch;
  answer->triangle_a = found->moving_triangle;
  answer->triangle_b = found->fixed_triangle;
  nsvcd__f3_store(nsvcd__f3_round(point), answer->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), answer->normal);
}

// Proves a question whose motion has been prepared, if it can; else the answer is UNDECIDED and
// says yes.
static void nsvcd__answer_by_proof(nsvcd__query *query, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  const double unit = (double)task->motion.unit;
  const double measure = (double)(task->options->measure / task->motion.unit);
  nsvcd__search *search = &query->broad_phase;
  nsvcd__proof *p = query->proof;
  nsvcd__proof_begin(query);
  if (p->given.skin > 0) nsvcd__lift_motion(p, search);
  nsvcd__verdict verdict = nsvcd__prove(p, search);
  if (measure > 0 && verdict != NSVCD__WITHIN) {
    nsvcd__measure(p, search, verdict, measure);
    // A distance decides what was left undecided, but tells nothing of what is inside of what.
    const int meets = p->known.has_contact && p->known.found.distance <= p->given.clearance;
    const int is_clear =
        p->low > 0 && p->low >= p->given.clearance && !p->unclear && !p->within;
    if (verdict == NSVCD__UNDECIDED && (meets || is_clear))
      verdict = meets ? NSVCD__MEETS : NSVCD__FREE;
  }

  // The triangles that the answer names are those of a contact, or else of a doubt.
  const int is_doubt = verdict == NSVCD__UNDECIDED && p->known.unsure < NSVCD__NEVER;
  const int names = p->known.has_contact || is_doubt;
  const int is_within = verdict == NSVCD__WITHIN;
  const int is_free = verdict == NSVCD__FREE;
  nsvcd__answer_free(answer);
  answer->work = p->work;
  if (names || is_within) nsvcd__answer_with_contact(p, task->swapped, answer);

  // What is proven of clearances and times.
  const double until = nsvcd__clear_until(p) / (double)p->ask.motion->ticks;
  double proven = is_free;
  if (!is_free && p->given.share > 0 && !is_within) proven = fmin(fmax(until, 0), 1);
  const double low = is_free ? fmax(p->given.clearance, p->low) : p->low;
  double high = p->high;
  if (names) {
    const nsvcd__contact *found = &p->known.found;
    const float quanta = nsvcd__quanta_of(p, found->moving_patch, found->fixed_patch);
    high = found->distance + (double)quanta;
  }
  answer->free_until = (float)(proven < 1 ? proven * (1 - 1e-7) : 1);
  answer->clearance_low = (float)(low * unit * (1 - 1e-6));
  answer->clearance_high = is_within ? 0 : (float)(high * unit * (1 + 1e-6));

  // By what the moving body was lifted, in the world at the start.
  const nsvcd__to_world start = nsvcd__to_world_at(p->ask.motion, 0);
  const nsvcd__d3 lift =
      nsvcd__dmat3_apply(&start.rotation, nsvcd__d3_widen(p->ask.motion->lift));
  const nsvcd__d3 metres = nsvcd__d3_scale(lift, p->given.skin > 0 ? start.unit : 0);
  nsvcd__f3_store(nsvcd__f3_round(metres), answer->lift);

  answer->status = NSVCD_STATUS_UNDECIDED;
  if (is_free) answer->status = NSVCD_STATUS_CERTIFIED_FREE;
  if (is_within) answer->status = NSVCD_STATUS_INSIDE;
  if (verdict == NSVCD__MEETS) answer->status = NSVCD_STATUS_WITNESS;
  answer->collides = !is_free;
  answer->logit = is_free ? -NSVCD_LOGIT_CERTAIN : NSVCD_LOGIT_CERTAIN;
}
#endif  // NSVCD_NO_PROOF
