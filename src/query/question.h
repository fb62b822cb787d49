// In: questions and a workspace. Out: answers, or why not. The public functions of queries.
#pragma once
#include "../gradient/gradient.h"
#include "by_proof.h"

// The method that answers, or DEFAULT where there is none.
static nsvcd_method nsvcd__method_of(const nsvcd_body *moving, const nsvcd_body *fixed,
                                     nsvcd_method wanted) {
  int can_prove = 0;
  int can_ask = 0;
#ifndef NSVCD_NO_PROOF
  can_prove = moving->triangles && fixed->triangles;
#endif
#ifndef NSVCD_NO_NETWORK
  can_ask = moving->weights_id && fixed->weights_id;
#endif
  if (can_prove && wanted != NSVCD_METHOD_NETWORK) return NSVCD_METHOD_PROOF;
  if (can_ask && wanted != NSVCD_METHOD_PROOF) return NSVCD_METHOD_NETWORK;
  return NSVCD_METHOD_DEFAULT;
}

// Is a question in order?
static nsvcd_result nsvcd__question_check(const nsvcd_question *q) {
  const nsvcd_mover *a = &q->a;
  const nsvcd_mover *b = &q->b;
  nsvcd_result result = nsvcd__mover_check(a);
  if (!result) result = nsvcd__mover_check(b);
  if (result) return result;
  // The same body in the same motion: something was passed twice.
  const float scale_a = nsvcd__scale_of(a);
  const float scale_b = nsvcd__scale_of(b);
  const int same_size = !(scale_a < scale_b) && !(scale_b < scale_a);
  const int same_motion = a->poses == b->poses && a->times == b->times && a->count == b->count;
  if (a->body == b->body && same_motion && same_size) return NSVCD_ERROR_SAME;

  // Are the options' numbers in their ranges, and do they go together?
  if ((unsigned)q->method > (unsigned)NSVCD_METHOD_NETWORK) return NSVCD_ERROR_METHOD;
  if ((unsigned)q->ask > (unsigned)NSVCD_ASK_DISTANCE) return NSVCD_ERROR_ASK;
  if (q->segments > NSVCD__MAX_SEGMENTS || q->segments % NSVCD__LANES)
    return NSVCD_ERROR_SEGMENTS;
  if (!nsvcd__is_length(q->tolerance)) return NSVCD_ERROR_TOLERANCE;
  if (!nsvcd__is_length(q->clearance)) return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_length(q->slop)) return NSVCD_ERROR_SLOP;
  const int is_first = q->ask == NSVCD_ASK_FIRST;
  if (!nsvcd__is_length(q->to) || (q->to > 0 && q->ask == NSVCD_ASK_HIT))
    return NSVCD_ERROR_TO;
  if (!nsvcd__is_length(q->to_time) || q->to_time > (is_first ? 1.0f : 0.0f))
    return NSVCD_ERROR_TO_TIME;
  if (q->manifold && !is_first) return NSVCD_ERROR_MANIFOLD;
  // The network knows nothing of these.
  const int by_network = q->method == NSVCD_METHOD_NETWORK;
  const int needs_proof = q->clearance > 0 || q->slop > 0 || is_first || q->to > 0 ||
                          q->surfaces || (q->ask == NSVCD_ASK_DISTANCE && !by_network);
  if (needs_proof && by_network) return NSVCD_ERROR_METHOD;
  const nsvcd_method wanted = needs_proof ? NSVCD_METHOD_PROOF : q->method;
  if (nsvcd__method_of(a->body, b->body, wanted) == NSVCD_METHOD_DEFAULT)
    return wanted == NSVCD_METHOD_NETWORK ? NSVCD_ERROR_LATENTS : NSVCD_ERROR_TRIANGLES;
#ifndef NSVCD_NO_NETWORK
  nsvcd__settings unused;
  return nsvcd__settings_of(&q->network, a->body->patches, b->body->patches, &unused);
#else
  return NSVCD_OK;
#endif
}

// ---- who moves

// The extent of a body, with what it goes beyond its triangles.
static float nsvcd__extent_of(const nsvcd_mover *mover) {
  const nsvcd_body *body = mover->body;
  return nsvcd__scale_of(mover) * (body->extent + (nsvcd__whole_radius(body) - body->radius));
}

// Does b move, seen in a's frame? Of two bodies the one that moves does, else the smaller one. If
// they are equal, any rule will do that does not depend on which of them is a: then both ways of
// asking get the same answer.
static int nsvcd__is_swapped(const nsvcd_mover *a, const nsvcd_mover *b) {
  const size_t count_a = nsvcd__pose_count(a);
  const size_t count_b = nsvcd__pose_count(b);
  if ((count_a > 1) != (count_b > 1)) return count_b > 1;
  const float size_a = nsvcd__extent_of(a);
  const float size_b = nsvcd__extent_of(b);
  if (size_a < size_b || size_b < size_a) return size_b < size_a;
  if (a->body->checksum != b->body->checksum) return b->body->checksum < a->body->checksum;
  if (count_a != count_b) return count_b < count_a;
  const nsvcd_pose *poses_a = a->poses ? a->poses : &nsvcd__at_origin;
  const nsvcd_pose *poses_b = b->poses ? b->poses : &nsvcd__at_origin;
  const int order = memcmp(poses_b, poses_a, count_a * sizeof *poses_a);
  if (order || count_a == 1 || a->times == b->times) return order < 0;
  if (!a->times || !b->times) return !b->times;
  return memcmp(b->times, a->times, count_a * sizeof *a->times) < 0;
}

// ---- lay out

// What a question that is in order needs; NULL: what any may need.
static nsvcd__needs nsvcd__needs_of(const nsvcd_question *q) {
  nsvcd__needs needs = {NSVCD__TILE_SLOTS, NSVCD__TILE_SLOTS, 1, NSVCD__MAX_SEGMENTS, 0, 1};
#ifndef NSVCD_NO_NETWORK
  needs.candidates = NSVCD__SHORTLIST * NSVCD_MAX_PAIRS;
#endif
  if (!q) return needs;
  const nsvcd_body *a = q->a.body;
  const nsvcd_body *b = q->b.body;
  const int swapped = nsvcd__is_swapped(&q->a, &q->b);
  const size_t moving_groups = nsvcd__body_groups(swapped ? b : a);
  const size_t fixed_groups = nsvcd__body_groups(swapped ? a : b);
  if (moving_groups < NSVCD__TILE_SLOTS) needs.moving_groups = moving_groups;
  if (fixed_groups < NSVCD__TILE_SLOTS) needs.fixed_groups = fixed_groups;
  needs.large = nsvcd__is_tiled(a, b);
  if (q->segments) needs.segments = nsvcd__round_up(q->segments, NSVCD__LANES);
  needs.proof = nsvcd__method_of(a, b, q->method) == NSVCD_METHOD_PROOF;
#ifndef NSVCD_NO_NETWORK
  const nsvcd_network_options *o = &q->network;
  const size_t pairs = o->pairs ? o->pairs : NSVCD_DEFAULT_PAIRS;
  const size_t most = o->model == NSVCD_MODEL_TINY ? pairs : NSVCD__SHORTLIST * pairs;
  needs.candidates = most > NSVCD__PORTION ? most : NSVCD__PORTION;
  if (!a->weights_id || !b->weights_id) needs.candidates = 0;
#endif
  return needs;
}

NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question) {
  if (question && nsvcd__question_check(question)) return 0;
  const nsvcd__needs needs = nsvcd__needs_of(question);
  return nsvcd__query_layout(&needs, NULL);
}

// Checks a question, and that the workspace is large enough for it.
static NSVCD__NOINLINE nsvcd_result nsvcd__sweep_check(const nsvcd_question *q,
                                                       const void *workspace,
                                                       size_t workspace_size) {
  const nsvcd_result result = nsvcd__question_check(q);
  if (result) return result;
  if (!workspace || !nsvcd__is_aligned(workspace)) return NSVCD_ERROR_WORKSPACE;
  const nsvcd__needs needs = nsvcd__needs_of(q);
  const size_t size = nsvcd__query_layout(&needs, NULL);
  return workspace_size >= size ? NSVCD_OK : NSVCD_ERROR_WORKSPACE;
}

// Lays out a checked question in the workspace, and chooses who moves.
static NSVCD__NOINLINE nsvcd__query *nsvcd__query_open(nsvcd__isa isa, const nsvcd_question *q,
                                                       void *workspace) {
  const nsvcd__needs needs = nsvcd__needs_of(q);
  nsvcd__query *query = (nsvcd__query *)workspace;
  nsvcd__task *task = &query->task;
  (void)nsvcd__query_layout(&needs, (char *)workspace);
  query->isa = isa;
  task->swapped = nsvcd__is_swapped(&q->a, &q->b);
  const nsvcd_mover *moving = task->swapped ? &q->b : &q->a;
  const nsvcd_mover *fixed = task->swapped ? &q->a : &q->b;
  nsvcd__motion_init(moving, fixed, &task->motion);
  task->moving = moving->body;
  task->fixed = fixed->body;
  task->lengths = task->motion.scale * task->moving->extent + task->fixed->extent;
  task->lengths += nsvcd__pivot_arms(&task->motion);
  task->method = nsvcd__method_of(task->moving, task->fixed, q->method);
  task->question = q;
#ifndef NSVCD_NO_NETWORK
  task->decisive = NULL;
#if NSVCD__ROWS == 1
  task->row = (float *)(void *)query->broad_phase.met;
#endif
#endif
  return query;
}

// ---- answer, and write

static void nsvcd__swap(uint32_t *a, uint32_t *b) {
  const uint32_t first = *a;
  *a = *b;
  *b = first;
}

// Exchanges a and b in what was found about the moving body and the fixed one.
static void nsvcd__swap_contact(nsvcd_contact *c) {
  nsvcd__swap(&c->patch_a, &c->patch_b);
  nsvcd__swap(&c->triangle_a, &c->triangle_b);
  const float gap = c->gap < HUGE_VALF ? c->gap : 0;
  for (size_t k = 0; k < 3; k++) {
    c->point[k] += gap * c->normal[k];
    c->normal[k] = 0 - c->normal[k];
  }
}
static void nsvcd__swap_answer(nsvcd_answer *answer) {
  const nsvcd_pose moving = answer->safe.a;
  answer->safe.a = answer->safe.b;
  answer->safe.b = moving;
  nsvcd__swap(&answer->opinion.patch_a, &answer->opinion.patch_b);
  nsvcd__swap_contact(&answer->nearest);
  for (size_t n = 0; n < answer->contact_count; n++) nsvcd__swap_contact(&answer->contacts[n]);
  for (size_t k = 0; k < 3; k++) answer->push_out[k] = 0 - answer->push_out[k];
}

#ifndef NSVCD_NO_NETWORK
// Answers a question whose motion has been prepared, by the network.
static void nsvcd__answer_by_network(nsvcd__query *query, nsvcd__hint *hint,
                                     nsvcd_answer *answer) {
  nsvcd_opinion opinion;
  const int inside = NSVCD__KERNEL(query->isa, ask_network)(query, hint, &opinion);
  nsvcd__answer_begin(&query->task, opinion.logit > 0 ? NSVCD_HIT : NSVCD_FREE, answer);
  answer->inside = inside;
  answer->opinion = opinion;
  if (query->broad_phase.balls_met || inside) answer->by = NSVCD_BY_NETWORK;
  if (opinion.logit > 0) answer->time.high = opinion.time;
}
#endif

// Answers a question that has been checked and laid out. hint: NULL, or a batch's, for the network.
static void nsvcd__answer_query(nsvcd__query *query, nsvcd__hint *hint, nsvcd_answer *answer) {
  const nsvcd__task *task = &query->task;
  (void)hint;
#ifndef NSVCD_NO_PROOF
  if (task->method == NSVCD_METHOD_PROOF) nsvcd__answer_by_proof(query, answer);
#endif
#if !defined(NSVCD_NO_PROOF) && !defined(NSVCD_NO_NETWORK)
  // The network has an opinion on what a proof leaves undecided, unless a clearance, a slop or a
  // distance is asked for.
  const nsvcd_question *q = task->question;
  const int knows = task->moving->weights_id && task->fixed->weights_id &&
                    !(q->clearance > 0 || q->ask == NSVCD_ASK_DISTANCE || q->slop > 0);
  if (task->method == NSVCD_METHOD_PROOF && answer->verdict == NSVCD_UNDECIDED && knows)
    (void)NSVCD__KERNEL(query->isa, ask_network)(query, NULL, &answer->opinion);
#endif
#ifndef NSVCD_NO_NETWORK
  if (task->method == NSVCD_METHOD_NETWORK) nsvcd__answer_by_network(query, hint, answer);
#endif
  if (task->swapped) nsvcd__swap_answer(answer);
}

// As nsvcd_sweep_batch, by the kernels of one instruction set.
static nsvcd_result nsvcd__run_batch(nsvcd__isa isa, const nsvcd_question *questions,
                                     size_t count, void *workspace, size_t workspace_size,
                                     nsvcd_answer *answers) {
  nsvcd__hint hint = {0, 0, 0, 0};
  int swapped = 0;
  if (count > 0 && (!questions || !answers)) return NSVCD_ERROR_ARGUMENT;
  for (size_t k = 0; k < count; k++) {
    const nsvcd_result result = nsvcd__sweep_check(&questions[k], workspace, workspace_size);
    if (result) return result;
  }
  for (size_t k = 0; k < count; k++) {
    const nsvcd_question *q = &questions[k];
    nsvcd__query *query = nsvcd__query_open(isa, q, workspace);
    // The hint is about patches of the moving body and of the fixed one.
    const int same = k > 0 && q->a.body == q[-1].a.body && q->b.body == q[-1].b.body;
    if (!same || query->task.swapped != swapped) memset(&hint, 0, sizeof hint);
    swapped = query->task.swapped;
    nsvcd__answer_query(query, &hint, &answers[k]);
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer) {
  return nsvcd__run_batch(nsvcd__isa_at_hand(), question, 1, workspace, workspace_size,
                          answer);
}

NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers) {
  return nsvcd__run_batch(nsvcd__isa_at_hand(), questions, count, workspace, workspace_size,
                          answers);
}

#ifndef NSVCD_NO_GRADIENT
// As nsvcd_sweep_gradient, by the kernels of one instruction set.
static nsvcd_result nsvcd__run_gradient(nsvcd__isa isa, const nsvcd_question *question,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answer, float *gradient_a,
                                        float *gradient_b) {
  if (!question || !answer || (!gradient_a && !gradient_b)) return NSVCD_ERROR_ARGUMENT;
  if (question->method == NSVCD_METHOD_PROOF) return NSVCD_ERROR_METHOD;
  nsvcd_question by_network = *question;
  by_network.method = NSVCD_METHOD_NETWORK;
  const nsvcd_result result = nsvcd__sweep_check(&by_network, workspace, workspace_size);
  if (result) return result;
  nsvcd__query *query = nsvcd__query_open(isa, &by_network, workspace);
  nsvcd__task *task = &query->task;
  nsvcd__decisive decisive;
  task->decisive = &decisive;
  nsvcd__answer_query(query, NULL, answer);
  float *const out[2] = {task->swapped ? gradient_b : gradient_a,
                         task->swapped ? gradient_a : gradient_b};
  if (out[0]) memset(out[0], 0, 6 * task->motion.moving.count * sizeof(float));
  if (out[1]) memset(out[1], 0, 6 * task->motion.fixed.count * sizeof(float));
  if (answer->opinion.candidates > 0 && !answer->inside) nsvcd__gradient(query, out);
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b) {
  return nsvcd__run_gradient(nsvcd__isa_at_hand(), question, workspace, workspace_size, answer,
                             gradient_a, gradient_b);
}
#endif
