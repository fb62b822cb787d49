// In: two parts of a pair, and their frames. Out: a question about them, as one of them sees it.
//
// Poses in float keep their digits where coordinates are small. Those of two parts that are near
// each other are, however far from the world's origin, in the frame of one of them: of the part
// that rests, if one does; else of b, half way.
#pragma once
#include "samples.h"

// The frame that local poses are in.
typedef struct nsvcd__local {
  // in the world
  nsvcd__dpose frame;
  // metres, at most: the sum of both parts' errors by poses in float
  double rounding;
} nsvcd__local;

// Fills in c->local. frames: of a and of b, (count) each, but one of a part that rests.
static nsvcd__local nsvcd__localize(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                    const nsvcd__dpose *const *frames, size_t count) {
  const size_t parts[2] = {pair->a, pair->b};
  const int moves[2] = {c->scene->parts[pair->a].link > 0, c->scene->parts[pair->b].link > 0};
  nsvcd__local local = {moves[0] ? frames[1][moves[1] ? count / 2 : 0] : frames[0][0], 0};
  for (size_t n = 0; n < 2; n++) {
    double most = 0;
    for (size_t k = 0; k < (moves[n] ? count : 1); k++) {
      const nsvcd__dpose in = nsvcd__dpose_inverse_mul(&local.frame, &frames[n][k]);
      c->local[n][k] = nsvcd__dpose_round(&in);
      most = nsvcd__max(most, nsvcd__d3_norm(in.position));
    }
    // of positions and of quaternions as floats
    if (moves[n]) local.rounding += 2 * (1.1e-7 * most + 1.3e-7 * c->members[parts[n]].extent);
  }
  return local;
}

// The same in the configuration c->at.
static nsvcd__local nsvcd__localize_at(nsvcd_checker *c, const nsvcd_body_pair *pair) {
  const nsvcd__dpose a = nsvcd__frame_of_part(c, c->at, pair->a);
  const nsvcd__dpose b = nsvcd__frame_of_part(c, c->at, pair->b);
  const nsvcd__dpose *const frames[2] = {&a, &b};
  return nsvcd__localize(c, pair, frames, 1);
}

// Takes a contact from the local frame to the world.
static void nsvcd__contact_to_world(const nsvcd__local *local, nsvcd_contact *contact) {
  const nsvcd__dpose *frame = &local->frame;
  const nsvcd__d3 point = nsvcd__dpose_apply(frame, nsvcd__d3_load(contact->point));
  const nsvcd__d3 normal =
      nsvcd__dquat_rotate(frame->rotation, nsvcd__d3_load(contact->normal));
  nsvcd__f3_store(nsvcd__f3_round(point), contact->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), contact->normal);
}

// Of two parts in their local poses, (count) each, but one of a part that rests.
static nsvcd_question nsvcd__question_of(const nsvcd_checker *c, const nsvcd_body_pair *pair,
                                         size_t count, size_t work) {
  const size_t parts[2] = {pair->a, pair->b};
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_part *part = &c->scene->parts[parts[n]];
    nsvcd_mover *mover = n ? &q.b : &q.a;
    mover->body = part->body;
    mover->scale = part->scale;
    mover->poses = c->local[n];
    mover->count = part->link ? count : 1;
  }
  q.method = NSVCD_METHOD_PROOF;
  q.surfaces = c->surfaces;
  q.work = work ? work : NSVCD_DEFAULT_WORK;
  return q;
}

// Returns the verdict; UNDECIDED where c->result is an error.
static nsvcd_verdict nsvcd__ask_sweep(nsvcd_checker *c, const nsvcd_question *q,
                                      nsvcd_answer *found) {
  memset(found, 0, sizeof *found);
  nsvcd_question asked = *q;
  asked.stop = c->stop;
  asked.user = c->user;
  if (!c->result) c->result = nsvcd_sweep(&asked, c->query, c->query_size, found);
  c->units += found->work;
  return found->verdict;
}
