// In: two parts of a scene. Out: the joints between them, how far these move a point of one part as
// the other sees it, and a checker of these two parts alone.
//
// THE BOUND. Let d(q) be the distance of two parts. If one joint turns by w, and the others stay,
// d changes by no more than w r: r is the farthest that a point of one part is from that joint's
// axis. That holds of either part, since turning one is turning the other back: so r is the lesser
// of both. Where a joint slides, r is 1. In a box of joint values, which reach h_k to either side
// of its centre, joints may change one after another. So from the centre d changes by no more than
//   sum over joints k of h_k r_k
// A joint that mimics another reaches its multiplier times as far.
// r_k: of all configurations of the box. It is that of the centre, where no point is farther than
// the part's sphere or the corners of its box, and what the joints between the
// part and k add: the chord 2 r sin(h / 2) of each, h up to pi, or h if it slides.
// Source: this library.
#pragma once
#include "../interface/ranges.h"
#include "check.h"

// metres, about: the extent of a probe
#define NSVCD__PROBE 1e-6
// of a clearance: how far a part may deviate at last
#define NSVCD__SPAN_FINEST 0.05

// A point that rides on one of the two parts: some body, shrunk, is put there as a third part.
typedef struct nsvcd__probe {
  // on which: 0 or 1
  int side;
  // in that part's link
  float position[3];
  // its depth in the other part, over how far it moves in a box
  double score;
} nsvcd__probe;

// Two parts, and the joints between them.
typedef struct nsvcd__span {
  nsvcd_scene scene;
  // the two, and the probe
  nsvcd_part parts[3];
  // the two; then the probe and one of them
  nsvcd_body_pair pairs[2];
  // of this scene
  nsvcd_checker *checker;
  // joints from the first part to the second, through the link that carries both; and which of
  // `path` drives each
  size_t way[NSVCD_MAX_JOINTS], drivers[NSVCD_MAX_JOINTS];
  size_t way_count;
  // those that drive them
  size_t path[NSVCD_MAX_JOINTS];
  size_t joints;
  // what joints off the path are at, and, of the path, the centre of a box
  double at[NSVCD_MAX_JOINTS];
  // of the path: the box, half its widths, and r of the banner
  double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS];
  double half[NSVCD_MAX_JOINTS], arms[NSVCD_MAX_JOINTS];
  // of the way: half the widths, and the sines of half of these
  double reach[NSVCD_MAX_JOINTS], sines[NSVCD_MAX_JOINTS];
  // metres: what both parts go beyond their triangles, and these beyond those of their meshes
  double beyond;
  // metres: no point of a probe is farther from its position
  double probe_extent;
} nsvcd__span;

// The joints from link a to link b, in order. A link's parent has a lower number than the link.
static size_t nsvcd__path_between(const nsvcd_scene *scene, uint32_t a, uint32_t b,
                                  size_t *path) {
  size_t down[NSVCD_MAX_JOINTS];
  size_t count = 0;
  size_t down_count = 0;
  while (a != b) {
    uint32_t *outer = a > b ? &a : &b;
    *(outer == &a ? &path[count++] : &down[down_count++]) = *outer - 1;
    *outer = scene->joints[*outer - 1].parent;
  }
  while (down_count > 0) path[count++] = down[--down_count];
  return count;
}

// The least and the greatest value of a joint. A full turn is a little more than one.
static void nsvcd__values_of(const nsvcd_joint *joint, double *low, double *high) {
  const int is_endless = joint->kind == NSVCD_JOINT_CONTINUOUS;
  *low = is_endless ? 0 : joint->low;
  *high = is_endless ? 6.28318530717960 : joint->high;
}

// A sphere about a part, or a probe, in the world; and a box about the part.
typedef struct nsvcd__rider {
  nsvcd__d3 centre;
  double radius;
  // the middle of the box, and from there to its sides; 0 of a probe
  nsvcd__d3 middle, sides[3];
} nsvcd__rider;

static nsvcd__rider nsvcd__rider_of(const nsvcd_checker *c, const nsvcd__links *at,
                                    size_t part) {
  const nsvcd__member *m = &c->members[part];
  const nsvcd__dpose *frame = &at->frames[c->scene->parts[part].link];
  const nsvcd__dpose at_part = nsvcd__dpose_mul(frame, &m->frame);
  nsvcd__rider out;
  out.centre = nsvcd__dpose_apply(frame, m->centre);
  out.radius = m->radius;
  out.middle = nsvcd__dpose_apply(&at_part, m->middle);
  for (size_t k = 0; k < 3; k++) {
    nsvcd__d3 side = {0, 0, 0};
    // distances are those of triangles
    nsvcd__d3_set_axis(&side, k, 1.000001 * (nsvcd__d3_axis(m->half, k) - m->round));
    out.sides[k] = nsvcd__dquat_rotate(at_part.rotation, side);
  }
  return out;
}

// The farthest that a point of a rider is from an axis through a point: no farther than a corner of
// its box, nor than its sphere reaches.
static double nsvcd__across(const nsvcd__rider *rider, nsvcd__d3 axis, nsvcd__d3 foot) {
  const nsvcd__d3 off = nsvcd__d3_cross(axis, nsvcd__d3_sub(rider->centre, foot));
  const nsvcd__d3 middle = nsvcd__d3_cross(axis, nsvcd__d3_sub(rider->middle, foot));
  double most = 0;
  for (size_t corner = 0; corner < 8; corner++) {
    nsvcd__d3 out = middle;
    for (size_t k = 0; k < 3; k++)
      out =
          nsvcd__d3_fma(corner >> k & 1 ? 1 : -1, nsvcd__d3_cross(axis, rider->sides[k]), out);
    most = nsvcd__max(most, nsvcd__d3_dot(out, out));
  }
  return nsvcd__min(nsvcd__d3_norm(off) + rider->radius, sqrt(most));
}

// r of the banner, of the joints of a way from one part to the other, which reach so far to either
// side. riders: each on the link of one part.
static void nsvcd__arms_along(const nsvcd_checker *c, const size_t *way, size_t count,
                              const double *reach, const nsvcd__links *at,
                              const nsvcd__rider *riders, double *arms) {
  for (size_t side = 0; side < 2; side++) {
    double moved = 0;
    for (size_t n = 0; n < count; n++) {
      const size_t k = side ? count - 1 - n : n;
      const size_t j = way[k];
      const double across =
          nsvcd__across(&riders[side], at->axes[j], at->frames[j + 1].position);
      const int slides = nsvcd__slides(c, j);
      const double arm = slides ? 1 : across + moved;
      const double half = nsvcd__min(reach[k], 3.141592653589793);
      moved += slides ? reach[k] : 2 * arm * sin(0.5 * half);
      arms[k] = side ? nsvcd__min(arms[k], arm) : arm;
    }
  }
}

// Those of the joints of a span's path, each with all that it drives.
static void nsvcd__arms_between(nsvcd__span *s, const nsvcd__links *at,
                                const nsvcd__rider *riders) {
  double rates[NSVCD_MAX_JOINTS], arms[NSVCD_MAX_JOINTS];
  for (size_t k = 0; k < s->way_count; k++) {
    rates[k] = fabs(nsvcd__rate(&s->scene, s->way[k]));
    s->reach[k] = rates[k] * s->half[s->drivers[k]];
    s->sines[k] = sin(0.5 * nsvcd__min(s->reach[k], 3.141592653589793));
  }
  nsvcd__arms_along(s->checker, s->way, s->way_count, s->reach, at, riders, arms);
  for (size_t k = 0; k < s->joints; k++) s->arms[k] = 0;
  for (size_t k = 0; k < s->way_count; k++) s->arms[s->drivers[k]] += rates[k] * arms[k];
}

// The bound of the banner, without one joint of the path, or NSVCD_NONE.
static double nsvcd__travel_but(const nsvcd__span *s, size_t without) {
  double sum = 0;
  for (size_t k = 0; k < s->joints; k++) sum += k == without ? 0 : s->half[k] * s->arms[k];
  return sum * (1 + 1e-9);
}

NSVCDDEF nsvcd_result nsvcd_pair_travel(const nsvcd_checker *c, nsvcd_body_pair pair,
                                        const double *low, const double *high, double *moved) {
  double middles[NSVCD_MAX_JOINTS] = {0};
  double half[NSVCD_MAX_JOINTS] = {0};
  double arms[NSVCD_MAX_JOINTS];
  size_t way[NSVCD_MAX_JOINTS];
  nsvcd__links at;
  if (!c || !low || !high || !moved) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = c->scene;
  if (pair.a >= scene->part_count || pair.b >= scene->part_count ||
      scene->parts[pair.a].link == scene->parts[pair.b].link)
    return NSVCD_ERROR_PAIR;
  const size_t count =
      nsvcd__path_between(scene, scene->parts[pair.a].link, scene->parts[pair.b].link, way);
  for (size_t k = 0; k < count; k++) {
    const size_t j = way[k];
    if (!nsvcd__are_numbers(&low[j], 1) || !nsvcd__are_numbers(&high[j], 1) ||
        low[j] > high[j])
      return NSVCD_ERROR_VALUE;
    const double middle = 0.5 * (low[j] + high[j]);
    middles[j] = middle;
    half[k] = nsvcd__max(high[j] - middle, middle - low[j]) * (1 + 1e-15);
  }
  nsvcd__place_links(c, middles, &at);
  const nsvcd__rider riders[2] = {nsvcd__rider_of(c, &at, pair.a),
                                  nsvcd__rider_of(c, &at, pair.b)};
  nsvcd__arms_along(c, way, count, half, &at, riders, arms);
  for (size_t j = 0; j < scene->joint_count; j++) moved[j] = 0;
  for (size_t k = 0; k < count; k++) moved[way[k]] = half[k] * arms[k] * (1 + 1e-9);
  return NSVCD_OK;
}

// The joint of the path that moves points farthest.
static size_t nsvcd__farthest_joint(const nsvcd__span *s) {
  size_t out = 0;
  for (size_t k = 1; k < s->joints; k++) {
    if (s->half[k] * s->arms[k] > s->half[out] * s->arms[out]) out = k;
  }
  return out;
}

// Asks about the two parts, or about the probe and the surface of the part that it does not ride
// on, in the configuration s->at, or along a joint of the path through all of the box.
static nsvcd_result nsvcd__ask_span(nsvcd__span *s, int is_probe, size_t along,
                                    double clearance, const nsvcd_range_options *o,
                                    nsvcd_check_answer *answer) {
  const size_t joints = s->scene.joint_count;
  double points[2 * NSVCD_MAX_JOINTS];
  const nsvcd_joint_motion motion = {along != NSVCD_NONE, 1, points, NULL};
  nsvcd_check_options options = {0, 0, o->work, o->stop, o->user, 0};
  if (clearance > 0) options.clearance = nsvcd__above(clearance);
  options.finest = (float)nsvcd__max((double)NSVCD__FINEST, clearance * NSVCD__SPAN_FINEST);
  memcpy(points, s->at, joints * sizeof *points);
  memcpy(points + joints, s->at, joints * sizeof *points);
  if (along != NSVCD_NONE) {
    points[s->path[along]] = s->low[along];
    points[joints + s->path[along]] = s->high[along];
  }
  nsvcd__follow(&s->scene, 1 + (along != NSVCD_NONE), points);
  s->scene.pairs = s->checker->own.pairs = &s->pairs[is_probe];
  s->checker->surfaces = is_probe;
  return nsvcd_check(s->checker, &motion, &options, answer);
}

// Takes a box about whose centre s->at is then: (2, joints) of the path, low and high.
static void nsvcd__take_box(nsvcd__span *s, const double *box) {
  for (size_t k = 0; k < s->joints; k++) {
    s->low[k] = box[k];
    s->high[k] = box[s->joints + k];
    const double middle = 0.5 * (s->low[k] + s->high[k]);
    s->at[s->path[k]] = middle;
    s->half[k] = nsvcd__max(s->high[k] - middle, middle - s->low[k]) * (1 + 1e-15);
  }
  nsvcd__follow(&s->scene, 1, s->at);
}

// The parts and joints of a span, without its checker.
static void nsvcd__span_begin(const nsvcd_scene *scene, nsvcd_body_pair pair, nsvcd__span *s) {
  memset(s, 0, sizeof *s);
  s->scene = *scene;
  s->scene.parts = s->parts;
  s->scene.pairs = s->pairs;
  s->scene.part_count = 3;
  s->scene.pair_count = 1;
  s->scene.clearances = NULL;
  s->scene.allowances = NULL;
  s->scene.allowance_count = 0;
  s->scene.cone_count = 0;
  s->parts[0] = scene->parts[pair.a];
  s->parts[1] = scene->parts[pair.b];
  s->pairs[0].b = 1;
  s->way_count = nsvcd__path_between(scene, s->parts[0].link, s->parts[1].link, s->way);
  for (size_t n = 0; n < s->way_count; n++) {
    const size_t driver = nsvcd__driver(scene, s->way[n]);
    size_t k = 0;
    while (k < s->joints && s->path[k] != driver) k++;
    if (k == s->joints) s->path[s->joints++] = driver;
    s->drivers[n] = k;
  }
  for (size_t j = 0; j < scene->joint_count; j++) {
    double low, high;
    nsvcd__values_of(&scene->joints[j], &low, &high);
    s->at[j] = 0.5 * (low + high);
  }
  nsvcd__follow(scene, 1, s->at);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_body_facts facts = nsvcd_body_describe(s->parts[n].body);
    const double scale = s->parts[n].scale > 0 ? (double)s->parts[n].scale : 1;
    s->beyond += scale * ((double)facts.convex_radius + (double)facts.quantization_error);
  }
  // of all bodies the one with the fewest triangles
  nsvcd_part *probe = &s->parts[2];
  size_t fewest = SIZE_MAX;
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd_body_facts facts = nsvcd_body_describe(scene->parts[n].body);
    if (facts.triangles >= fewest) continue;
    fewest = facts.triangles;
    const float extent = facts.extent + facts.convex_radius;
    probe->body = scene->parts[n].body;
    probe->scale = (float)nsvcd__max(nsvcd__min(NSVCD__PROBE / (double)extent, 1),
                                     (double)NSVCD_MIN_SCALE);
    s->probe_extent = 1.00001 * (double)(extent * probe->scale);
  }
  probe->pose.rotation[3] = 1;
  // it has a row of samples if it is on a link that moves
  probe->link = s->parts[0].link ? s->parts[0].link : s->parts[1].link;
}

// Puts the probe at a point of the link of one of the parts.
static void nsvcd__put_probe(nsvcd__span *s, const nsvcd__probe *at) {
  nsvcd__member *m = &s->checker->members[2];
  const size_t row = m->row;
  s->parts[2].link = s->parts[at->side].link;
  memcpy(s->parts[2].pose.position, at->position, sizeof at->position);
  s->pairs[1].a = 2;
  s->pairs[1].b = at->side ? 0 : 1;
  *m = nsvcd__member_of(&s->parts[2]);
  m->row = row;
}
