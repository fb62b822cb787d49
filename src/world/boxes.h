// In: a body, and the poses of its way. Out: a box in the world that holds all of it on that way.
#pragma once
#include "../ground/motions.h"
#include "../ground/valid.h"

// relative errors of floats, of poses and of boxes
#define NSVCD__BOX_ROUNDING 1e-6

// A body's box in its frame, and how far its points are from its pivot at most; scaled, with its
// convex radius.
typedef struct nsvcd__shape_box {
  nsvcd__d3 centre, half, pivot;
  double reach;
} nsvcd__shape_box;

static nsvcd__shape_box nsvcd__shape_box_of(const nsvcd_mover *mover) {
  const nsvcd_body_facts facts = nsvcd_body_describe(mover->body);
  const double scale = mover->scale > 0 ? (double)mover->scale : 1;
  const nsvcd__d3 low = nsvcd__d3_load(facts.low);
  const nsvcd__d3 high = nsvcd__d3_load(facts.high);
  const double more = (double)facts.convex_radius + (double)facts.quantization_error;
  const nsvcd__d3 around = nsvcd__d3_of(more, more, more);
  nsvcd__shape_box out;
  out.centre = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5 * scale);
  out.half = nsvcd__d3_fma(0.5, nsvcd__d3_sub(high, low), around);
  out.half = nsvcd__d3_scale(out.half, scale);
  out.pivot = nsvcd__d3_scale(nsvcd__d3_load(mover->pivot), scale);
  const nsvcd__d3 to_centre = nsvcd__d3_sub(out.centre, out.pivot);
  const nsvcd__d3 away = nsvcd__d3_of(fabs(to_centre.x), fabs(to_centre.y), fabs(to_centre.z));
  out.reach = nsvcd__d3_norm(nsvcd__d3_add(away, out.half));
  return out;
}

static nsvcd__box nsvcd__box_over(nsvcd__box a, nsvcd__box b) {
  const nsvcd__box out = {nsvcd__f3_min(a.low, b.low), nsvcd__f3_max(a.high, b.high)};
  return out;
}

static int nsvcd__boxes_meet(const nsvcd__box *a, const nsvcd__box *b) {
  return !nsvcd__f3_exceeds(a->low, b->high) && !nsvcd__f3_exceeds(b->low, a->high);
}

static nsvcd__box nsvcd__box_around(nsvcd__box box, double by) {
  const float more = nsvcd__above(by);
  const nsvcd__f3 around = nsvcd__f3_of(more, more, more);
  const nsvcd__box out = {nsvcd__f3_sub(box.low, around), nsvcd__f3_add(box.high, around)};
  return out;
}

// The box of a pose, larger by `more`.
static nsvcd__box nsvcd__box_of_pose(const nsvcd__shape_box *shape, const nsvcd_pose *pose,
                                     double more) {
  const nsvcd__dpose at = nsvcd__dpose_of(pose);
  const nsvcd__dtransform place = nsvcd__dtransform_of(&at);
  const nsvcd__dmat3 *r = &place.rotation;
  const nsvcd__d3 h = shape->half;
  const nsvcd__d3 centre = nsvcd__d3_transform(&place, shape->centre);
  const double size =
      nsvcd__d3_norm(at.position) + nsvcd__d3_norm(shape->pivot) + shape->reach;
  more += NSVCD__BOX_ROUNDING * size;
  const nsvcd__d3 half =
      nsvcd__d3_of(fabs(r->x.x) * h.x + fabs(r->x.y) * h.y + fabs(r->x.z) * h.z + more,
                   fabs(r->y.x) * h.x + fabs(r->y.y) * h.y + fabs(r->y.z) * h.z + more,
                   fabs(r->z.x) * h.x + fabs(r->z.y) * h.y + fabs(r->z.z) * h.z + more);
  const nsvcd__box out = {nsvcd__d3_narrow(nsvcd__d3_sub(centre, half)),
                          nsvcd__d3_narrow(nsvcd__d3_add(centre, half))};
  return out;
}

// The box of a way. Where it turns by an angle h, a point leaves the chord between two poses by no
// more than an eighth of h squared, per metre from the pivot.
static nsvcd__box nsvcd__box_of_way(const nsvcd__shape_box *shape, const nsvcd_pose *poses,
                                    size_t count, double more) {
  nsvcd__box out = nsvcd__box_of_pose(shape, &poses[0], more);
  for (size_t k = 1; k < count; k++) {
    const double turn = 2 * nsvcd__slerp_of(&poses[k - 1], &poses[k]).half_angle;
    const double bend = 0.126 * turn * turn * shape->reach;
    const nsvcd__box from = nsvcd__box_of_pose(shape, &poses[k - 1], more + bend);
    const nsvcd__box to = nsvcd__box_of_pose(shape, &poses[k], more + bend);
    out = nsvcd__box_over(out, nsvcd__box_over(from, to));
  }
  return out;
}

// Is a turn so near to half a turn that rounding may decide which way it goes?
static int nsvcd__is_half_turn(const nsvcd_pose *poses, size_t count) {
  return count > 1 && nsvcd__slerp_of(&poses[0], &poses[1]).half_angle > 1.5;
}

// A pose as it is seen from a frame.
static nsvcd_pose nsvcd__seen_from(const nsvcd_pose *frame, const nsvcd_pose *pose) {
  const nsvcd__dpose from = nsvcd__unit_dpose(frame);
  const nsvcd__dpose at = nsvcd__unit_dpose(pose);
  const nsvcd__dtransform place = nsvcd__dtransform_of(&from);
  nsvcd__dpose out;
  out.rotation = nsvcd__dquat_mul(nsvcd__dquat_inverse(from.rotation), at.rotation);
  out.position =
      nsvcd__dmat3_apply_transpose(&place.rotation, nsvcd__d3_sub(at.position, from.position));
  return nsvcd__dpose_round(&out);
}

// Do the boxes of a way of one or two poses, larger by `more`, and of a body at rest meet in a
// frame? A line is one, and a slerp is one, in any frame that does not move.
static int nsvcd__boxes_meet_in(const nsvcd_pose *frame, const nsvcd__shape_box *shape,
                                const nsvcd_pose *poses, size_t count, double more,
                                const nsvcd__shape_box *other, const nsvcd_pose *at) {
  const nsvcd_pose there = nsvcd__seen_from(frame, at);
  nsvcd_pose way[2];
  for (size_t k = 0; k < count; k++) way[k] = nsvcd__seen_from(frame, &poses[k]);
  const nsvcd__box a = nsvcd__box_of_way(shape, way, count, more);
  const nsvcd__box b = nsvcd__box_of_pose(other, &there, 0);
  return nsvcd__boxes_meet(&a, &b);
}
