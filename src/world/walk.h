// In: a character that stands, or stood. Out: it walks on grounds, along walls, up and down steps.
#pragma once
#include "ways.h"

static nsvcd__d3 nsvcd__flat_part(const nsvcd__slide *s, nsvcd__d3 a) {
  return nsvcd__d3_fma(-nsvcd__d3_dot(a, s->up), s->up, a);
}

// Has it go with what it stands on.
static void nsvcd__ride(nsvcd__slide *s) {
  if (!s->ground) return;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  s->ridden = nsvcd__driven_speed(s, s->ground->body, nsvcd__pivot_at(s));
  s->thing.linear = nsvcd__d3_add(own, s->ridden);
}

// What is too steep to stand on is a wall. For whoever stands it is upright; who is in the air
// slides down it, but does not rise by walking into it. An edge that feet stand on is level: it
// bears them, and neither throws them up nor stops them.
static void nsvcd__meet_walls(nsvcd__slide *s) {
  for (size_t k = s->kept; k < s->contact_count; k++) {
    nsvcd__hold *h = &s->holds[k];
    const double rise = nsvcd__d3_dot(h->normal, s->up);
    if (!(rise > 0) || rise >= s->slope) continue;
    if (s->is_on_edge && rise >= NSVCD__EDGE_SLOPE) {
      h->normal = s->up;
      continue;
    }
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
    const nsvcd__d3 n = s->is_on_edge ? s->up : nsvcd__d3_load(s->ground->contact.normal);
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

// How high the lowest corner of its box is.
static double nsvcd__sole(const nsvcd__slide *s) {
  const nsvcd__shape_box *box = &s->ask.shape;
  const nsvcd__dpose at = nsvcd__dpose_of(&s->pose);
  const nsvcd__dtransform place = nsvcd__dtransform_of(&at);
  const nsvcd__d3 up = nsvcd__dmat3_apply_transpose(&place.rotation, s->up);
  const nsvcd__d3 high = nsvcd__d3_of(fabs(up.x), fabs(up.y), fabs(up.z));
  return nsvcd__d3_dot(nsvcd__d3_transform(&place, box->centre), s->up) -
         nsvcd__d3_dot(high, box->half);
}

static double nsvcd__height_of(const nsvcd__slide *s, const nsvcd_world_contact *c) {
  return nsvcd__d3_dot(nsvcd__d3_load(c->contact.point), s->up);
}

// Does it stand, no higher than a step above where it began to climb?
static int nsvcd__is_on_step(const nsvcd__slide *s) {
  return s->ground && nsvcd__height_of(s, s->ground) <= s->floor + (double)s->given->step;
}

// The radius of feet, by a contact so high above their sole: as if they were a ball.
static double nsvcd__ball_of(const nsvcd__slide *s, nsvcd__d3 normal, double high) {
  const double radius = high / (1 - nsvcd__d3_dot(normal, s->up));
  return nsvcd__min(nsvcd__max(radius, 0), s->ask.shape.reach);
}

// Round feet meet the edge of a step long before they are above it. It is one if there is ground,
// no higher than a step, as soon as it is so far below them that it bears them: they come no
// farther where the next edge is before them. A ball's contact tells how far that is, of which the
// feet are taken for a part: at cosines between that of a ground and 1. Moves the body there, or
// wherever it gets to.
static int nsvcd__is_edge_of_step(nsvcd__slide *s, nsvcd__d3 normal, double high) {
  static const double parts[2] = {0.1, 0.5};
  const double step = (double)s->given->step;
  const double gap = 2 * (s->clearance + 2 * s->margin);
  const nsvcd__d3 flat = nsvcd__flat_part(s, normal);
  const double lies = nsvcd__d3_norm(flat);
  const double radius = nsvcd__ball_of(s, normal, high);
  const double risen = step * nsvcd__go_by(s, nsvcd__d3_scale(s->up, step));
  double along = 0;
  for (int k = 0; k < 2; k++) {
    const double bears = s->slope + parts[k] * (1 - s->slope);
    const double by = gap + radius * (lies - sqrt(1 - bears * bears));
    if (nsvcd__go_by(s, nsvcd__d3_scale(flat, (along - by) / lies)) < 1) return 0;
    along = by;
    const nsvcd_pose above = s->pose;
    (void)nsvcd__go_by(s, nsvcd__d3_scale(s->up, -risen - s->margin));
    nsvcd__slide_look(s);
    if (nsvcd__is_on_step(s)) return 1;
    s->pose = above;
  }
  return 0;
}

// Onto a step, or its edge, if there is one: up, along, and down again. What has been gone of the
// way is not gone again.
static void nsvcd__climb(nsvcd__slide *s, const nsvcd_world_contact *before) {
  const double step = (double)s->given->step;
  const nsvcd_pose start = s->pose;
  const double sole = nsvcd__sole(s);
  const nsvcd__d3 normal = nsvcd__d3_load(before->contact.normal);
  const double edge = nsvcd__height_of(s, before);
  s->floor = s->ground ? nsvcd__height_of(s, s->ground) : sole;
  const double time = s->left * s->seconds * s->pace;
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const nsvcd__d3 way = nsvcd__d3_scale(nsvcd__flat_part(s, own), time);
  const double risen = step * nsvcd__go_by(s, nsvcd__d3_scale(s->up, step));
  const double gone = nsvcd__go_by(s, way);
  const double drop = risen + s->margin;
  const double dropped = drop * nsvcd__go_by(s, nsvcd__d3_scale(s->up, -drop));
  const nsvcd_pose above = s->pose;
  int is_up = dropped < risen - s->margin && gone > 0;
  if (is_up) nsvcd__slide_look(s);
  if (dropped < risen && gone > 0 && !(is_up && nsvcd__is_on_step(s)) &&
      edge <= s->floor + step) {
    s->pose = start;
    is_up = s->is_on_edge = nsvcd__is_edge_of_step(s, normal, edge - sole);
    s->pose = above;
    if (is_up) nsvcd__slide_look(s);
  }
  if (is_up && nsvcd__is_on_step(s)) {
    s->pace *= 1 - gone;
    return;
  }
  s->is_on_edge = 0;
  s->pose = start;
  nsvcd__slide_look(s);
}

// Looks for a ground; or else for the edge of a step that feet have come over, and walk away from.
static void nsvcd__seek_ground(nsvcd__slide *s) {
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  s->is_on_edge = 1;
  nsvcd__slide_look(s);
  const nsvcd__d3 n = s->ground ? nsvcd__d3_load(s->ground->contact.normal) : s->up;
  s->is_on_edge = nsvcd__d3_dot(n, s->up) < s->slope;
  if (!s->is_on_edge || nsvcd__d3_dot(walks, n) > 0) return;
  s->is_on_edge = 0;
  s->ground = NULL;
}

// Beyond the edge that feet have come over, is there a ground no lower than a step?
static int nsvcd__leads_down(nsvcd__slide *s) {
  const double step = (double)s->given->step;
  const nsvcd__d3 normal = nsvcd__d3_load(s->ground->contact.normal);
  const double edge = nsvcd__height_of(s, s->ground);
  const nsvcd__d3 flat = nsvcd__flat_part(s, normal);
  const double lies = nsvcd__d3_norm(flat);
  const double radius = nsvcd__ball_of(s, normal, edge - nsvcd__sole(s));
  const double by = 2 * (s->clearance + 2 * s->margin) + radius * (1 - lies);
  const nsvcd_pose here = s->pose;
  (void)nsvcd__go_by(s, nsvcd__d3_scale(flat, by / lies));
  (void)nsvcd__go_by(s, nsvcd__d3_scale(s->up, -step));
  s->is_on_edge = 0;
  nsvcd__slide_look(s);
  const int leads = s->ground && nsvcd__height_of(s, s->ground) >= edge - step;
  s->pose = here;
  s->is_on_edge = leads;
  nsvcd__slide_look(s);
  return leads;
}

// Whoever stood on a ground and walked off it steps down, if there is a ground to step down on, or
// the edge of a step that leads down to one; a margin farther on, if a riser it leaves is too near.
static void nsvcd__step_down(nsvcd__slide *s) {
  const nsvcd_pose above = s->pose;
  const double step = (double)s->given->step;
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  const double pace = nsvcd__max(nsvcd__d3_norm(walks), 1e-9);
  for (int k = 0; k < 2; k++) {
    (void)nsvcd__go_by(s, nsvcd__d3_scale(walks, k * s->margin / pace));
    if (nsvcd__go_by(s, nsvcd__d3_scale(s->up, -step)) >= 1) break;
    nsvcd__seek_ground(s);
    if (s->ground && (!s->is_on_edge || nsvcd__leads_down(s))) return;
    s->pose = above;
  }
  s->pose = above;
  s->is_on_edge = 0;
  nsvcd__slide_look(s);
}

// Whoever stood, and did not jump, does not fly off what it walked up: it keeps no speed upwards.
static void nsvcd__stop_climbing(nsvcd__slide *s) {
  const nsvcd__d3 own = nsvcd__d3_sub(s->thing.linear, s->ridden);
  const double up = nsvcd__max(nsvcd__d3_dot(own, s->up), 0);
  if (s->jumps) return;
  s->thing.linear = nsvcd__d3_fma(-up, s->up, s->thing.linear);
}

// The lowest of what is too steep to stand on in the way of whoever stands or is on an edge, or
// none.
static const nsvcd_world_contact *nsvcd__step_before(const nsvcd__slide *s) {
  const nsvcd__d3 walks = nsvcd__flat_part(s, nsvcd__d3_sub(s->thing.linear, s->ridden));
  const nsvcd_world_contact *out = NULL;
  if (!(s->given->step > 0) || s->jumps) return NULL;
  for (size_t k = s->kept; k < s->contact_count; k++) {
    const nsvcd_world_contact *c = &s->contacts[k];
    const nsvcd__d3 n = s->holds[k].normal;
    const double rise = nsvcd__d3_dot(n, s->up);
    const double into = -nsvcd__d3_dot(walks, n);
    if (!s->ground && !(rise > NSVCD__EDGE_SLOPE)) continue;
    if (!(rise > -0.01 && rise < s->slope && into > 0.05 * nsvcd__d3_norm(walks))) continue;
    if (!out || nsvcd__height_of(s, c) < nsvcd__height_of(s, out)) out = c;
  }
  return out;
}
