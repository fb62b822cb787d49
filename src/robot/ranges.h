// In: two parts of a robot. Out: do they meet never, always or sometimes, over all values of the
// joints between them?
//
// Some configurations are tried first (robot/meetings.h). If the parts meet in some and not in
// others, that is the answer. If they meet in none, boxes of values are proven to be free; if in
// all, to be such that a point of one part stays inside of the other:
//
//   free   a plane that parts the two (robot/partings.h); or a sweep along one joint of the box,
//          with all that the other joints can move a point as a clearance (robot/spans.h)
//   hit    a point inside of both parts rides on one of them. Along the same sweep, with the same
//          clearance, it does not meet the surface of the other part: so it stays inside of it. Two
//          solids that have a point in common meet: either their surfaces do, or a component of one
//          is inside of the other
//
// A box that is neither is cut in two, along the joint that moves points farthest; or, where the
// best plane is nearer to being enough than the sweep, that brings them nearest along its normal.
#pragma once
#include "meetings.h"
#include "partings.h"

// the default; and of a box, beside its questions
#define NSVCD__RANGE_UNITS 4000000
#define NSVCD__BOX_UNITS 10
// boxes that are kept. While more than half of these are left, the newest is taken first, so that
// they are not too many
#define NSVCD__KEPT_BOXES 4096
// boxes that are given up before the search is
#define NSVCD__MOST_DROPPED 64
// the first boxes that fail, and every so many later, have the slope followed
#define NSVCD__FIRST_SLOPES 24
#define NSVCD__NEXT_SLOPES 64
// metres: a box in which points move by less is not cut
#define NSVCD__LEAST_TRAVEL 2e-5
// the share of the joint that is swept along, when a box is cut
#define NSVCD__SWEPT_SHARE 0.25
// points on each axis, and others, that are tried for a probe
#define NSVCD__AXIS_POINTS 8
#define NSVCD__OTHER_POINTS 32
// units for a question about a probe in one configuration
#define NSVCD__PROBE_WORK 20000

// ---- boxes

static double *nsvcd__box_at(nsvcd__ranging *r, size_t n) {
  return r->boxes + (r->first + n) % r->capacity * (2 * r->span.joints + 1);
}

// Gives the box that was taken up.
static void nsvcd__drop_box(nsvcd__ranging *r, const double *box) {
  r->dropped += box[2 * r->span.joints];
  r->dropped_count++;
}

// Cuts the box that was taken, along the joint of its path that moves most.
static void nsvcd__cut_box(nsvcd__ranging *r, const double *box, const double *moved) {
  const nsvcd__span *s = &r->span;
  const size_t size = 2 * s->joints + 1;
  const double share = box[size - 1];
  size_t joint = 0;
  for (size_t k = 1; k < s->joints; k++)
    if (moved[k] > moved[joint]) joint = k;
  if (!(nsvcd__travel_but(s, NSVCD_NONE) > NSVCD__LEAST_TRAVEL)) {
    if (!r->answer.why) r->answer.why = NSVCD_WHY_TOO_NEAR;
    nsvcd__drop_box(r, box);
    return;
  }
  if (r->count + 2 > r->capacity) {
    r->answer.why = NSVCD_WHY_WORK;
    nsvcd__drop_box(r, box);
    return;
  }
  for (size_t n = 0; n < 2; n++) {
    double *half = nsvcd__box_at(r, r->count++);
    memcpy(half, box, size * sizeof *half);
    half[n ? joint : s->joints + joint] = s->at[s->path[joint]];
    half[size - 1] = 0.5 * share;
  }
}

// Asks about the configuration that a check names, where the parts are near each other or not; from
// there the slope is followed, if enough boxes failed.
static void nsvcd__try_near(nsvcd__ranging *r, size_t along, const nsvcd_check_answer *found,
                            double sign) {
  nsvcd__span *s = &r->span;
  double centre[NSVCD_MAX_JOINTS];
  const size_t failed = r->failed++;
  const int is_followed = failed < NSVCD__FIRST_SLOPES || failed % NSVCD__NEXT_SLOPES == 0;
  const int is_near = !(found->contact.gap > r->options.clearance);
  if (!is_followed && sign < 0 && !is_near) return;
  memcpy(centre, s->at, sizeof centre);
  if (along != NSVCD_NONE)
    s->at[s->path[along]] = s->low[along] + found->fraction * (s->high[along] - s->low[along]);
  (void)nsvcd__note_here(r);
  if (is_followed && !nsvcd__range_is_over(r)) nsvcd__follow_slope(r, sign);
  memcpy(s->at, centre, sizeof centre);
}

// Is the box free, all of it? If not, it is cut. Where its centre is too near, no sweep through it
// is free.
static void nsvcd__prove_free(nsvcd__ranging *r, const double *box) {
  nsvcd__span *s = &r->span;
  nsvcd_check_answer found;
  nsvcd__links at;
  double moved[NSVCD_MAX_JOINTS];
  nsvcd__place_links(s->checker, s->at, &at);
  const nsvcd__rider riders[2] = {nsvcd__rider_of(s->checker, &at, 0),
                                  nsvcd__rider_of(s->checker, &at, 1)};
  nsvcd__arms_between(s, &at, riders);
  r->units += NSVCD__BOX_UNITS;
  const double kept = (double)r->options.clearance + s->beyond;
  const nsvcd__parting parting = nsvcd__best_parting(s, &at, riders, kept);
  if (parting.apart > kept) return;
  const size_t along = nsvcd__farthest_joint(s);
  const double travel = nsvcd__travel_but(s, along);
  const double clearance = (double)r->options.clearance + travel;
  size_t asked = NSVCD_NONE;
  if (nsvcd__ask_range(r, 0, asked, clearance, &found) == NSVCD_FREE) {
    asked = along;
    if (nsvcd__ask_range(r, 0, asked, clearance, &found) == NSVCD_FREE) return;
  }
  if (r->result) return;
  if (found.verdict == NSVCD_HIT) nsvcd__try_near(r, asked, &found, -1);
  if (travel > 0) {
    for (size_t k = 0; k < s->joints; k++) moved[k] = s->half[k] * s->arms[k];
    moved[along] *= NSVCD__SWEPT_SHARE;
    // by how much of the room that there is for it either bound is too much
    const double room =
        nsvcd__max((double)found.contact.gap - (double)r->options.clearance, 0);
    if ((parting.centre - parting.apart) * room < travel * (parting.centre - kept))
      nsvcd__losses_of(s, &at, riders, &parting, moved);
    nsvcd__cut_box(r, box, moved);
    return;
  }
  // no more can be told of it
  r->answer.why = found.why ? found.why : NSVCD_WHY_TOO_NEAR;
  nsvcd__drop_box(r, box);
}

// ---- probes

// Is a probe inside a part, for certain, and farther from its surface than `room`?
static int nsvcd__is_enclosed_by(nsvcd__span *s, nsvcd_question q, double room) {
  nsvcd_checker *c = s->checker;
  nsvcd_answer found;
  q.surfaces = 0;
  if (nsvcd__ask_sweep(c, &q, &found) != NSVCD_HIT || !found.inside) return 0;
  q.surfaces = 1;
  q.clearance = nsvcd__above(room);
  return nsvcd__ask_sweep(c, &q, &found) == NSVCD_FREE;
}

// Is the probe inside the part that it rides on? Both are in that part's link, in poses that are
// not rounded.
static int nsvcd__is_own_point(nsvcd__span *s, const nsvcd__probe *probe) {
  const nsvcd_part *parts[2] = {&s->parts[2], &s->parts[probe->side]};
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  for (size_t n = 0; n < 2; n++) {
    nsvcd_mover *mover = n ? &q.b : &q.a;
    mover->body = parts[n]->body;
    mover->scale = parts[n]->scale;
    mover->poses = &parts[n]->pose;
    mover->count = 1;
  }
  q.method = NSVCD_METHOD_PROOF;
  q.work = NSVCD__PROBE_WORK;
  return nsvcd__is_enclosed_by(s, q, 2 * s->probe_extent);
}

// Is the probe inside the other part, in a configuration? *room: metres, at least as far is the
// surface to be, so that what is said of the rounded poses holds of the exact ones.
static int nsvcd__is_common_point(nsvcd__span *s, const nsvcd__links *at, double *room) {
  nsvcd_checker *c = s->checker;
  *c->at = *at;
  const nsvcd__local local = nsvcd__localize_at(c, &s->pairs[1]);
  const nsvcd_question q = nsvcd__question_of(c, &s->pairs[1], 1, NSVCD__PROBE_WORK);
  *room = 2 * (s->probe_extent + local.rounding);
  return nsvcd__is_enclosed_by(s, q, *room);
}

// The span's arms for a probe, which has been put in its place.
static void nsvcd__arms_of_probe(nsvcd__span *s, const nsvcd__links *at, size_t side) {
  nsvcd__rider riders[2];
  riders[side] = nsvcd__rider_of(s->checker, at, 2);
  const double radius = 2 * s->probe_extent;
  riders[side].radius = radius;
  riders[side].middle = riders[side].centre;
  for (size_t k = 0; k < 3; k++) {
    riders[side].sides[k] = nsvcd__d3_of(0, 0, 0);
    nsvcd__d3_set_axis(&riders[side].sides[k], k, radius);
  }
  riders[!side] = nsvcd__rider_of(s->checker, at, !side);
  nsvcd__arms_between(s, at, riders);
}

// Keeps a probe at a point of the world, if it is in both parts and among the best.
static void nsvcd__try_probe(nsvcd__ranging *r, const nsvcd__links *at, size_t side,
                             nsvcd__d3 point) {
  nsvcd__span *s = &r->span;
  nsvcd__probe probe;
  nsvcd_answer found;
  double room;
  const nsvcd__dpose *link = &at->frames[s->parts[side].link];
  const nsvcd__d3 off = nsvcd__d3_sub(point, link->position);
  const nsvcd__d3 in = nsvcd__dquat_rotate(nsvcd__dquat_inverse(link->rotation), off);
  probe.side = (int)side;
  nsvcd__f3_store(nsvcd__f3_round(in), probe.position);
  nsvcd__put_probe(s, &probe);
  s->checker->result = NSVCD_OK;
  if (!nsvcd__is_own_point(s, &probe) || !nsvcd__is_common_point(s, at, &room)) return;
  nsvcd_question q = nsvcd__question_of(s->checker, &s->pairs[1], 1, NSVCD__PROBE_WORK);
  q.surfaces = 1;
  q.ask = NSVCD_ASK_DISTANCE;
  (void)nsvcd__ask_sweep(s->checker, &q, &found);
  nsvcd__arms_of_probe(s, at, side);
  probe.score = (double)found.distance.low / (nsvcd__travel_but(s, NSVCD_NONE) + 1e-6);
  if (r->probe_count == NSVCD__KEPT_PROBES &&
      !(probe.score > r->probes[NSVCD__KEPT_PROBES - 1].score))
    return;
  size_t n = r->probe_count < NSVCD__KEPT_PROBES ? r->probe_count++ : NSVCD__KEPT_PROBES - 1;
  for (; n > 0 && r->probes[n - 1].score < probe.score; n--) r->probes[n] = r->probes[n - 1];
  r->probes[n] = probe;
}

// Seeks probes in the configuration span.at: on the axes of joints, about which they hardly move,
// and wherever both parts may be.
static void nsvcd__seek_probes(nsvcd__ranging *r, const nsvcd__links *at) {
  nsvcd__span *s = &r->span;
  const nsvcd__rider a = nsvcd__rider_of(s->checker, at, 0);
  const nsvcd__rider b = nsvcd__rider_of(s->checker, at, 1);
  const nsvcd__rider *small = a.radius < b.radius ? &a : &b;
  const size_t on_axes = NSVCD__AXIS_POINTS * s->way_count;
  nsvcd__bounds bounds[2];
  for (size_t n = 0; n < 2; n++) {
    const nsvcd__dpose frame = nsvcd__frame_of_part(s->checker, at, n);
    bounds[n] = nsvcd__bounds_of(&s->checker->members[n], &frame);
  }
  const nsvcd__d3 low = nsvcd__d3_max(bounds[0].low, bounds[1].low);
  const nsvcd__d3 high = nsvcd__d3_min(bounds[0].high, bounds[1].high);
  r->probe_count = 0;
  for (size_t n = 0; n < on_axes + NSVCD__OTHER_POINTS && !nsvcd__range_is_over(r); n++) {
    nsvcd__d3 point = low;
    for (size_t k = 0; k < 3; k++) {
      const double to = nsvcd__d3_axis(high, k);
      const double from = nsvcd__d3_axis(low, k);
      nsvcd__d3_set_axis(&point, k, from + nsvcd__random(&r->random) * (to - from));
    }
    if (n < on_axes) {
      const size_t j = s->way[n / NSVCD__AXIS_POINTS];
      const nsvcd__d3 foot = at->frames[j + 1].position;
      const double along = nsvcd__d3_dot(nsvcd__d3_sub(small->centre, foot), at->axes[j]);
      const double shift = (2 * nsvcd__random(&r->random) - 1) * small->radius;
      point = nsvcd__d3_fma(along + shift, at->axes[j], foot);
    }
    for (size_t side = 0; side < 2; side++) nsvcd__try_probe(r, at, side, point);
  }
}

// Does a probe stay inside of the other part in all of the box? If not, it is asked whether the
// parts meet where the probe leaves it.
static int nsvcd__stays_inside(nsvcd__ranging *r, const nsvcd__links *at,
                               const nsvcd__probe *probe) {
  nsvcd__span *s = &r->span;
  nsvcd_check_answer found;
  double room;
  nsvcd__put_probe(s, probe);
  s->checker->result = NSVCD_OK;
  if (!nsvcd__is_common_point(s, at, &room)) return 0;
  nsvcd__arms_of_probe(s, at, (size_t)probe->side);
  const size_t along = nsvcd__farthest_joint(s);
  const double travel = nsvcd__travel_but(s, along);
  if (nsvcd__ask_range(r, 1, along, travel + room, &found) == NSVCD_FREE) return 1;
  if (r->result) return 0;
  if (found.verdict == NSVCD_HIT && !nsvcd__range_is_over(r))
    nsvcd__try_near(r, along, &found, 1);
  return 0;
}

// Do the parts meet everywhere in the box? If that is not known, it is cut.
static void nsvcd__prove_hit(nsvcd__ranging *r, const double *box) {
  nsvcd__span *s = &r->span;
  double moved[NSVCD_MAX_JOINTS];
  nsvcd__links at;
  nsvcd__place_links(s->checker, s->at, &at);
  if (nsvcd__note_here(r) == NSVCD_FREE || r->result) return;
  for (size_t attempt = 0; attempt < 2; attempt++) {
    if (attempt) nsvcd__seek_probes(r, &at);
    for (size_t n = 0; n < r->probe_count; n++) {
      if (nsvcd__stays_inside(r, &at, &r->probes[n]) || nsvcd__range_is_over(r)) return;
    }
  }
  const nsvcd__rider riders[2] = {nsvcd__rider_of(s->checker, &at, 0),
                                  nsvcd__rider_of(s->checker, &at, 1)};
  if (!r->probe_count) nsvcd__arms_between(s, &at, riders);
  for (size_t k = 0; k < s->joints; k++) moved[k] = s->half[k] * s->arms[k];
  nsvcd__cut_box(r, box, moved);
}

// ---- the search

// Looks into boxes until all are decided; is_free: proves them to be free, else to be hit. Returns
// 1 if all of them are.
static int nsvcd__search_boxes(nsvcd__ranging *r, int is_free) {
  nsvcd__span *s = &r->span;
  const size_t size = 2 * s->joints + 1;
  double box[2 * NSVCD_MAX_JOINTS + 1];
  for (size_t k = 0; k < s->joints; k++)
    nsvcd__values_of(&s->scene.joints[s->path[k]], &r->boxes[k], &r->boxes[s->joints + k]);
  r->boxes[size - 1] = 1;
  r->first = 0;
  r->count = 1;
  r->dropped = 0;
  r->dropped_count = 0;
  r->failed = 0;
  r->answer.open = 1;
  r->answer.why = NSVCD_WHY_NOTHING;
  while (r->count > 0 && r->dropped_count < NSVCD__MOST_DROPPED && !nsvcd__range_is_over(r)) {
    if (r->answer.boxes == r->options.boxes) {
      r->answer.why = NSVCD_WHY_WORK;
      break;
    }
    const int is_oldest = r->count <= r->capacity / 2;
    memcpy(box, nsvcd__box_at(r, is_oldest ? 0 : r->count - 1), size * sizeof *box);
    r->first = (r->first + (size_t)is_oldest) % r->capacity;
    r->count--;
    r->answer.boxes++;
    nsvcd__take_box(s, box);
    (is_free ? nsvcd__prove_free : nsvcd__prove_hit)(r, box);
    // it may have been found that this search is in vain
    if (is_free ? r->answer.has_hit : r->answer.has_free) return 0;
  }
  r->answer.open = r->dropped;
  for (size_t n = 0; n < r->count; n++) r->answer.open += nsvcd__box_at(r, n)[size - 1];
  return !r->result && r->count == 0 && !(r->dropped > 0);
}

// Can anything be proven to be inside of a part?
static int nsvcd__may_enclose(const nsvcd_part *part) {
  const nsvcd_body_facts facts = nsvcd_body_describe(part->body);
  return !facts.open && facts.open_components < facts.components;
}

// The parts meet in all configurations that were tried: do they in all?
static void nsvcd__find_always(nsvcd__ranging *r) {
  nsvcd_range_answer *a = &r->answer;
  const nsvcd_part *parts = r->span.parts;
  if (nsvcd__may_enclose(&parts[0]) && nsvcd__may_enclose(&parts[1])) {
    if (nsvcd__search_boxes(r, 0)) a->meeting = NSVCD_MEETS_ALWAYS;
    return;
  }
  nsvcd__try_slopes(r, NSVCD__SLOPES_UP, 1);
  a->open = 1;
  if (!a->why) a->why = NSVCD_WHY_OPEN;
}

static void nsvcd__find_range(nsvcd__ranging *r) {
  nsvcd_range_answer *a = &r->answer;
  nsvcd__try_draws(r);
  // with few joints boxes are quicker
  if (!a->has_hit && r->span.joints > 2) nsvcd__try_slopes(r, NSVCD__SLOPES_DOWN, -1);
  if (!a->has_hit && nsvcd__search_boxes(r, 1)) a->meeting = NSVCD_MEETS_NEVER;
  if (a->has_hit && !a->has_free) nsvcd__find_always(r);
  if (a->has_free && a->has_hit) a->meeting = NSVCD_MEETS_SOMETIMES;
  if (a->meeting == NSVCD_MEETS_UNKNOWN) return;
  a->why = NSVCD_WHY_NOTHING;
  a->open = 0;
}

// Lays a search out at base; NULL: only counts. r: the span has its parts. Returns the bytes; 0 if
// they are too many.
static size_t nsvcd__range_layout(const nsvcd__ranging *r, char *base, nsvcd__ranging **laid,
                                  void **checker) {
  uint64_t used = 0;
  const size_t row = 2 * r->span.joints + 1;
  const size_t size = nsvcd_checker_size(&r->span.scene);
  *laid = NSVCD__TAKE_ROWS(nsvcd__ranging, 1, base, &used);
  double *boxes = NSVCD__TAKE_ROWS(double, r->capacity *row, base, &used);
  *checker = nsvcd__take(base, &used, 1, size);
  if (*laid) **laid = *r;
  if (*laid) (*laid)->boxes = boxes;
  return size && used <= SIZE_MAX ? (size_t)used : 0;
}

static nsvcd_result nsvcd__range_begin(const nsvcd_checker *c, nsvcd_body_pair pair,
                                       const nsvcd_range_options *options, nsvcd__ranging *r) {
  if (!c) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = c->scene;
  if (pair.a >= scene->part_count || pair.b >= scene->part_count ||
      scene->parts[pair.a].link == scene->parts[pair.b].link)
    return NSVCD_ERROR_PAIR;
  memset(r, 0, sizeof *r);
  if (options) r->options = *options;
  nsvcd_range_options *o = &r->options;
  if (!nsvcd__is_length(o->clearance)) return NSVCD_ERROR_CLEARANCE;
  if (o->boxes > NSVCD_MAX_BOXES) return NSVCD_ERROR_COUNT;
  o->boxes = o->boxes ? o->boxes : NSVCD_MAX_BOXES;
  o->units = o->units ? o->units : NSVCD__RANGE_UNITS;
  r->capacity = o->boxes < NSVCD__KEPT_BOXES ? o->boxes + 1 : NSVCD__KEPT_BOXES;
  r->random = o->seed;
  nsvcd__span_begin(scene, pair, &r->span);
  r->answer.joints = r->span.joints;
  return NSVCD_OK;
}

NSVCDDEF const char *nsvcd_meeting_string(nsvcd_meeting meeting) {
  static const char texts[][12] = {"unknown", "never", "always", "sometimes"};
  const size_t count = sizeof texts / sizeof texts[0];
  return (size_t)meeting < count ? texts[meeting] : "no meeting";
}

NSVCDDEF size_t nsvcd_pair_range_size(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                      const nsvcd_range_options *options) {
  nsvcd__ranging r;
  nsvcd__ranging *unused;
  void *none;
  if (nsvcd__range_begin(checker, pair, options, &r)) return 0;
  return nsvcd__range_layout(&r, NULL, &unused, &none);
}

NSVCDDEF nsvcd_result nsvcd_pair_range(const nsvcd_checker *checker, nsvcd_body_pair pair,
                                       const nsvcd_range_options *options, void *memory,
                                       size_t size, nsvcd_range_answer *answer) {
  nsvcd__ranging begun;
  nsvcd__ranging *r;
  void *own;
  nsvcd_result result = nsvcd__range_begin(checker, pair, options, &begun);
  if (result) return result;
  if (!answer) return NSVCD_ERROR_ARGUMENT;
  if (!memory || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  const size_t needed = nsvcd__range_layout(&begun, NULL, &r, &own);
  if (!needed || size < needed) return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__range_layout(&begun, (char *)memory, &r, &own);
  // its scene points into itself
  nsvcd__span_begin(checker->scene, pair, &r->span);
  const size_t own_size = nsvcd_checker_size(&r->span.scene);
  result = nsvcd_checker_open(&r->span.scene, own, own_size, &r->span.checker);
  if (result) return result;
  r->span.checker->stop = r->options.stop;
  r->span.checker->user = r->options.user;
  nsvcd__find_range(r);
  if (!r->result) *answer = r->answer;
  return r->result;
}
