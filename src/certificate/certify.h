// In: two motion models, two trees, perhaps an answer. Out: a certificate of what is free, of two
// triangles that meet, or of a corner that is inside; or none.
#pragma once
#include "../ground/random.h"
#include "traversal.h"

// rays that are tried for a component
#define NSVCD__RAYS 64
// instants at which a hit is looked for, and visits at each, at most
#define NSVCD__INSTANTS 12
#define NSVCD__INSTANT_VISITS 2000
// visits to all of the motion before that
#define NSVCD__FIRST_VISITS 100000

// ---- containment

// A direction to try: along the axes, then anywhere.
static nsvcd__coded_normal nsvcd__ray_to_try(size_t k, uint64_t *random) {
  nsvcd__d3 along = nsvcd__d3_of(0, 0, 0);
  nsvcd__d3_set_axis(&along, k % 3, k < 3 ? 1 : -1);
  // a little off, so that it does not run along faces that are parallel to an axis
  along = nsvcd__d3_add(along, nsvcd__d3_of(0.05, 0.07, 0.11));
  if (k >= 6) {
    along.x = nsvcd__random(random) - 0.5;
    along.y = nsvcd__random(random) - 0.5;
    along.z = nsvcd__random(random) - 0.5;
  }
  return nsvcd__normal_of(along, 8);
}

// Casts rays from all components of one body, at t = 0, which show them outside. FREE: all are
// written. HIT: one shows a corner inside, and the certificate is written. UNDECIDED: of some
// component none is clear.
static nsvcd_verdict nsvcd__cast_all(nsvcd__certifier *c, int whose) {
  const nsvcd_tree *tree = c->bodies[whose].tree;
  const nsvcd__seen s = nsvcd__seen_at(&c->bodies[whose], &c->bodies[!whose], 0);
  uint64_t random = 1;
  for (uint32_t v = 0; v < tree->mesh.vertex_count; v++) {
    if (tree->component[v] != v) continue;
    const nsvcd__d3 from = nsvcd__seen_vertex(&s, v);
    int shown = 0;
    for (size_t k = 0; k <= NSVCD__RAYS && !shown; k++) {
      const int same = k == 0;
      const nsvcd__coded_normal ray = nsvcd__ray_to_try(same ? 0 : k - 1, &random);
      const nsvcd__d3 along = same ? c->normals[0] : ray.along;
      int winding;
      if (!nsvcd__cast(&s, from, along, c->sums, &winding)) continue;
      shown = winding == 0;
      if (shown) {
        nsvcd__write_bits(c, (uint32_t)same, 1);
        if (!same) nsvcd__write_normal(c, NSVCD__REMEMBERED, &ray);
      } else if (!same) {
        nsvcd__write_head(c, NSVCD__PROVES_INSIDE);
        nsvcd__write_bits(c, 0, 32);
        nsvcd__write_bits(c, (uint32_t)whose, 1);
        nsvcd__write_bits(c, v, 32);
        nsvcd__write_normal(c, NSVCD__REMEMBERED, &ray);
        c->made->inside = 1;
        c->made->verdict = NSVCD_HIT;
        return NSVCD_HIT;
      }
    }
    if (!shown) return NSVCD_UNDECIDED;
  }
  return NSVCD_FREE;
}

// ---- answers

// Looks for a hit where an answer has one, and a little later and earlier: at the time itself the
// triangles may only touch.
static int nsvcd__meet_as_answered(nsvcd__certifier *c, const nsvcd_answer *answer) {
  const nsvcd_contact *hint = answer->contact_count > 0 ? answer->contacts : &answer->nearest;
  const int named = hint->triangle_a < c->bodies[0].tree->mesh.triangle_count &&
                    hint->triangle_b < c->bodies[1].tree->mesh.triangle_count;
  if (answer->verdict != NSVCD_HIT) return 0;
  for (int whose = 0; whose < 2 && answer->inside; whose++)
    if (nsvcd__cast_all(c, whose) == NSVCD_HIT) return 1;
  if (!named || !(hint->time >= 0)) return 0;
  if (nsvcd__meet_at(c, (double)hint->time, hint->triangle_a, hint->triangle_b)) return 1;
  for (double later = 1e-7; later < 1; later *= 2) {
    for (int k = 0; k < 2; k++) {
      const double when = (double)hint->time + (k ? -later : later);
      if (nsvcd__meet_at(c, when, hint->triangle_a, hint->triangle_b)) return 1;
    }
  }
  return 0;
}

// 1, 1/2, 1/4, 3/4, 1/8, 5/8, ...
static double nsvcd__bit_reversed(int k) {
  double fraction = k == 0;
  double bit = 0.5;
  for (int n = k; n > 0; n /= 2, bit /= 2) fraction += n % 2 * bit;
  return fraction;
}

// Looks for a hit at single instants, from an answer's on or anywhere.
static int nsvcd__meet_at_instants(nsvcd__certifier *c, const nsvcd_answer *answer,
                                   size_t visits) {
  if (answer && answer->verdict == NSVCD_FREE) return 0;
  const double said = answer ? (double)answer->time.high : -1;
  const int is_known = answer && answer->verdict == NSVCD_HIT && said >= 0 && said <= 1;
  const double from = is_known ? said : 0;
  for (int k = NSVCD__INSTANTS; k >= 0; k--) {
    // soon after an answer's; or at the end, a half, quarters, eighths
    const double fraction = is_known ? ldexp(1, -k) : nsvcd__bit_reversed(NSVCD__INSTANTS - k);
    const double t = nsvcd__min(from + (1 - from) * fraction, 1 - NSVCD__SHORTEST_INTERVAL);
    const size_t most = c->made->visits + NSVCD__INSTANT_VISITS;
    const size_t limit = most < visits ? most : visits;
    if (nsvcd__prove_traversal(c, t, t + NSVCD__SHORTEST_INTERVAL, limit) == NSVCD_HIT)
      return 1;
  }
  return 0;
}

// Over all time a traversal may lose itself among triangles that only touch, as those of flat
// bodies that are set down: then, and where an answer says so, a hit is looked for at instants.
static nsvcd_verdict nsvcd__prove_answer(nsvcd__certifier *c, const nsvcd_answer *answer,
                                         size_t visits) {
  const int is_hit = answer && answer->verdict == NSVCD_HIT;
  const size_t first = visits < NSVCD__FIRST_VISITS ? visits : NSVCD__FIRST_VISITS;
  if (!is_hit) {
    const nsvcd_verdict verdict = nsvcd__prove_traversal(c, 0, 1, first);
    const int is_open = verdict == NSVCD_UNDECIDED && c->made->why != NSVCD_WHY_NOTHING;
    if (!is_open || c->made->visits >= visits) return verdict;
  }
  const int touches = c->made->why == NSVCD_WHY_TOO_NEAR;
  const int meets = nsvcd__meet_at_instants(c, answer, visits);
  c->made->why = touches && !meets ? NSVCD_WHY_TOO_NEAR : NSVCD_WHY_NOTHING;
  if (meets) return NSVCD_HIT;
  return touches ? NSVCD_UNDECIDED : nsvcd__prove_traversal(c, 0, 1, visits);
}

static int nsvcd__has_open(const nsvcd_tree *tree) {
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) {
    if (tree->open[v]) return 1;
  }
  return 0;
}

// ---- nsvcd_certify

// Lays the workspace out at base, or, where that is NULL, only counts.
static uint64_t nsvcd__certifier_layout(size_t instants, const nsvcd_tree *a,
                                        const nsvcd_tree *b, char *base, nsvcd__certifier *c) {
  uint64_t used = 0;
  const size_t vertices = a->mesh.vertex_count > b->mesh.vertex_count ? a->mesh.vertex_count
                                                                      : b->mesh.vertex_count;
  c->interval.capacity = instants;
  c->interval.instants = NSVCD__TAKE_ROWS(nsvcd__instant, instants, base, &used);
  c->sums = NSVCD__TAKE_ROWS(int32_t, vertices, base, &used);
  return used;
}

NSVCDDEF size_t nsvcd_certify_models_workspace_size(size_t keyframes, const nsvcd_tree *a,
                                                    const nsvcd_tree *b) {
  nsvcd__certifier counted;
  if (!a || !b || keyframes > SIZE_MAX / 1024) return 0;
  const uint64_t size = nsvcd__certifier_layout(keyframes + 2, a, b, NULL, &counted);
  return size > SIZE_MAX ? 0 : (size_t)size;
}

NSVCDDEF nsvcd_result nsvcd_certify_models(
    const nsvcd_motion_model *models, size_t keyframes, float clearance, const nsvcd_tree *a,
    const nsvcd_tree *b, const nsvcd_certify_options *options, void *workspace,
    size_t workspace_size, uint8_t *bytes, size_t capacity, nsvcd_certificate *made) {
  const nsvcd_certify_options defaults = {NULL, 0};
  const nsvcd_certify_options *o = options ? options : &defaults;
  nsvcd__certifier c;
  nsvcd_certificate out;
  if (!models || !a || !b || !made || (capacity > 0 && !bytes)) return NSVCD_ERROR_ARGUMENT;
  memset(&c, 0, sizeof c);
  memset(&out, 0, sizeof out);
  if (!nsvcd__is_finite(clearance) || clearance < 0 || clearance > NSVCD_MAX_COORDINATE)
    return NSVCD_ERROR_CLEARANCE;
  const size_t needed = nsvcd_certify_models_workspace_size(keyframes, a, b);
  if (!workspace || !nsvcd__is_aligned(workspace) || !needed || workspace_size < needed)
    return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__certifier_layout(keyframes + 2, a, b, (char *)workspace, &c);
  c.bodies[0].tree = a;
  c.bodies[1].tree = b;
  for (size_t n = 0; n < 2; n++) c.bodies[n].model = models[n];
  c.interval.bodies = c.bodies;
  c.interval.clearance = (double)clearance;
  c.bytes = bytes;
  c.capacity = capacity;
  c.digest = nsvcd__digest(models[0].digest + 31 * models[1].digest, &clearance, 1);
  c.made = &out;
  const nsvcd_answer *told = o->answer;
  const size_t visits = o->visits ? o->visits : NSVCD_DEFAULT_VISITS;
  if (!told || !nsvcd__meet_as_answered(&c, told)) {
    out.verdict = nsvcd__prove_answer(&c, told, visits);
    if (out.verdict == NSVCD_FREE && !c.separated) out.verdict = nsvcd__cast_all(&c, 0);
    if (out.verdict == NSVCD_FREE && !c.separated) out.verdict = nsvcd__cast_all(&c, 1);
  }
  // of the meshes, of which none is mended: in a certificate an open component contains nothing
  const int is_inside = told && (told->inside || told->why == NSVCD_WHY_OPEN);
  const int has_open = nsvcd__has_open(a) || nsvcd__has_open(b);
  if (is_inside && has_open && out.verdict == NSVCD_FREE) {
    out.verdict = NSVCD_UNDECIDED;
    out.why = NSVCD_WHY_OPEN;
  }
  out.size = out.verdict == NSVCD_UNDECIDED ? 0 : (c.bits + 7) / 8;
  if (out.verdict == NSVCD_UNDECIDED && !out.why) out.why = NSVCD_WHY_TOO_NEAR;
  *made = out;
  return NSVCD_OK;
}

static size_t nsvcd__keyframes_of(const nsvcd_question *question) {
  return nsvcd__pose_count(&question->a) + nsvcd__pose_count(&question->b);
}

NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b) {
  if (!question || nsvcd__track_check(&question->a) || nsvcd__track_check(&question->b))
    return 0;
  return nsvcd_certify_models_workspace_size(nsvcd__keyframes_of(question), a, b);
}

NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made) {
  nsvcd_mover movers[2];
  nsvcd_motion_model models[2];
  if (!question || !a || !b || !made || (capacity > 0 && !bytes)) return NSVCD_ERROR_ARGUMENT;
  nsvcd_result result = nsvcd__model_of(&question->a, &movers[0], &models[0]);
  if (!result) result = nsvcd__model_of(&question->b, &movers[1], &models[1]);
  if (result) return result;
  if (!(question->slop <= 0 && question->slop >= 0)) return NSVCD_ERROR_SLOP;
  return nsvcd_certify_models(models, nsvcd__keyframes_of(question), question->clearance, a, b,
                              options, workspace, workspace_size, bytes, capacity, made);
}
