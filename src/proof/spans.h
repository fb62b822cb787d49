// In: a segment, or an arc and two shares of it. Out: a span: the poses at both ends, and by how
// much a point may leave the chord in between.
#pragma once
#include "../motion/segments.h"
#include "poses.h"

#ifndef NSVCD_NO_PROOF
// The time at which so many ticks have gone by.
static double nsvcd__time_of(const nsvcd__motion *motion, double ticks) {
  return motion->begin + motion->duration * ticks / (double)motion->ticks;
}

// The time a share u of the arc last asked for later than its start.
static double nsvcd__time_in_arc(const nsvcd__proof *p, double u) {
  return nsvcd__time_of(p->ask.motion, (double)p->arc.first + u * (double)p->arc.ticks);
}

// Leaves of the segments, whose ticks have become so much finer, a part of the motion, from one
// place to another. These are in segments: 1.5 is in the middle of the second.
static void nsvcd__narrow_segments(nsvcd__search *search, double from, double to,
                                   double finer) {
  uint32_t *begin = search->begin;
  const size_t first = (size_t)from;
  const size_t last = (size_t)to;
  const double fraction = to - (double)last;
  double end = (double)begin[last];
  if (fraction > 0) end += fraction * ((double)begin[last + 1] - end);
  const double start = (double)begin[first];
  const double into = (from - (double)first) * ((double)begin[first + 1] - start);
  search->segments = last - first + (fraction > 0);
  for (size_t s = 1; s < search->segments; s++)
    begin[s] = (uint32_t)(finer * (double)begin[first + s]);
  begin[0] = (uint32_t)(finer * (start + into));
  begin[search->segments] = (uint32_t)(finer * end);
}

static nsvcd__span nsvcd__span_of_segment(const nsvcd__motion *motion,
                                          const nsvcd__search *search, size_t s) {
  nsvcd__segments *block = &search->blocks[s / NSVCD__LANES];
  const size_t l = s % NSVCD__LANES;
  const nsvcd__mat3 turned = nsvcd__mat3_lane(block->turned, l);
  nsvcd__span span;
  span.start.rotation = nsvcd__mat3_lane(block->rotation, l);
  span.end.rotation = nsvcd__mat3_mix(1, &span.start.rotation, 1, &turned);
  span.start.position = nsvcd__lane_of(block->position, l);
  span.end.position = nsvcd__f3_add(span.start.position, nsvcd__lane_of(block->moved, l));
  span.bulge = block->bulge[l];
  span.rounding = block->rounding[l];
  span.drift = block->drift[l];
  span.axis = nsvcd__lane_of(block->axis, l);
  span.way = nsvcd__lane_of(block->way, l);
  span.bulge_along_axis = block->bulge_along_axis[l];
  span.drift_along_axis = block->drift_along_axis[l];
  span.drift_off_way = block->drift_off_way[l];
  span.t_start = nsvcd__time_of(motion, (double)search->begin[s]);
  span.t_end = nsvcd__time_of(motion, (double)search->begin[s + 1]);
  return span;
}

// Kept once it has been made.
static const nsvcd__span *nsvcd__segment_span(nsvcd__proof *p, const nsvcd__search *search,
                                              size_t s) {
  if (!(p->memo.spans >> s & 1)) {
    p->spans[s] = nsvcd__span_of_segment(p->ask.motion, search, s);
    p->spans[s].t_end =
        nsvcd__min(p->spans[s].t_end, nsvcd__time_of(p->ask.motion, p->ask.end));
  }
  p->memo.spans |= (uint64_t)1 << s;
  return &p->spans[s];
}

// The span from u0 to u1 of the arc that begins at the keyframe `first`.
static nsvcd__span nsvcd__span_of_arc(nsvcd__proof *p, uint32_t first, double u0, double u1) {
  const nsvcd__arc *arc = nsvcd__arc_at(p, first);
  const nsvcd__dtransform start = nsvcd__dtransform_at(arc, u0);
  const nsvcd__dtransform end = nsvcd__dtransform_at(arc, u1);
  const double square = (u1 - u0) * (u1 - u0);
  nsvcd__span span;
  span.start = nsvcd__transform_of(&start);
  span.end = nsvcd__transform_of(&end);
  const float remote_start = nsvcd__f3_length(span.start.position);
  const float remote = remote_start + nsvcd__f3_length(span.end.position);
  span.bulge = (float)(square * (arc->bulge + arc->twist) * 1.000001);
  span.drift = (float)(square * arc->drift * 1.000001);
  span.rounding = NSVCD__ROUNDING * (remote + p->given.lengths);
  span.drift_along_axis = span.drift_off_way = span.drift;
  span.axis = nsvcd__f3_round(arc->axis);
  span.way = span.axis;  // any
  const double wavers = square * (arc->bulge * arc->waver + arc->twist);
  span.bulge_along_axis = fminf((float)wavers + 1e-6f * span.bulge, span.bulge);
  span.t_start = nsvcd__time_in_arc(p, u0);
  span.t_end = nsvcd__time_in_arc(p, u1);
  return span;
}

// The axis as the moving body has it, unit.
static nsvcd__f3 nsvcd__own_axis(const nsvcd__span *span) {
  const nsvcd__f3 axis = nsvcd__mat3_apply_transpose(&span->start.rotation, span->axis);
  const float length = nsvcd__f3_length(axis);
  return nsvcd__f3_scale(axis, length > 0 ? 1 / length : 0);
}

// Of a patch's pieces.
static nsvcd__arm nsvcd__patch_arm(const nsvcd__facets *f, size_t patch,
                                   const nsvcd__span *span) {
  const float radius = nsvcd__body_r(f->body)[patch];
  return nsvcd__arm_of(nsvcd__facet_centre(f, patch), radius, nsvcd__own_axis(span));
}

// What points leave their chords by for the turn's sake, along any direction: |D x|, with D the
// difference between the true rotation and the chord's at some time. Split x into its parts along
// a', the axis as the moving body has it, and across it: then
//   |D x| <= |D| |x x a'| + |D a'| |x.a'|
// and |D a'| is |D^T axis|, since both ends of the chord take a' to the axis.
static float nsvcd__bulge_of(const nsvcd__span *span, nsvcd__arm arm) {
  const float by_axis = span->bulge * arm.radial + span->bulge_along_axis * arm.reach;
  return fminf(span->bulge * arm.reach, by_axis);
}

// What the points of the moving body leave their chords by along a direction n, times its length,
// but for rounding (which is times |n| too). With d the difference of the positions, a point x is
// off by n.(D x + d). Split n into its parts along the axis and across it: then
//   |n.D x| <= |n.axis| |D^T axis| |x| + |n x axis| |D x|
// and |n.d| is bounded in the same way, or with the way of the origin in place of the axis.
static float nsvcd__deviation_of(const nsvcd__span *span, nsvcd__f3 n, nsvcd__arm arm) {
  const float along = fabsf(nsvcd__f3_dot(n, span->axis));
  const float across = nsvcd__f3_length(nsvcd__f3_cross(n, span->axis));
  const float along_way = fabsf(nsvcd__f3_dot(n, span->way));
  const float across_way = nsvcd__f3_length(nsvcd__f3_cross(n, span->way));
  const float by_axis = along * span->drift_along_axis + across * span->drift;
  const float by_way = along_way * span->drift + across_way * span->drift_off_way;
  const float drift = by_axis < by_way ? by_axis : by_way;
  const float turn = along * span->bulge_along_axis * arm.reach;
  return drift + turn + across * nsvcd__bulge_of(span, arm);
}

// The same for a slice of directions, or one direction in a slice of spans.
typedef struct nsvcd__v_span {
  nsvcd__v3 axis, way;
  nsvcd__v rounding, drift, bulge, bulge_along_axis, drift_along_axis, drift_off_way;
} nsvcd__v_span;

NSVCD__INLINE nsvcd__v_span nsvcd__v_span_set(const nsvcd__span *span) {
  nsvcd__v_span out;
  out.axis = nsvcd__v3_set(span->axis);
  out.way = nsvcd__v3_set(span->way);
  out.rounding = nsvcd__v_set(span->rounding);
  out.drift = nsvcd__v_set(span->drift);
  out.bulge = nsvcd__v_set(span->bulge);
  out.bulge_along_axis = nsvcd__v_set(span->bulge_along_axis);
  out.drift_along_axis = nsvcd__v_set(span->drift_along_axis);
  out.drift_off_way = nsvcd__v_set(span->drift_off_way);
  return out;
}
// Lanes l and on of a block.
NSVCD__INLINE nsvcd__v_span nsvcd__v_span_load(const nsvcd__segments *block, size_t l) {
  nsvcd__v_span out;
  out.axis = nsvcd__v3_rows(block->axis[0] + l);
  out.way = nsvcd__v3_rows(block->way[0] + l);
  out.rounding = nsvcd__v_load(block->rounding + l);
  out.drift = nsvcd__v_load(block->drift + l);
  out.bulge = nsvcd__v_load(block->bulge + l);
  out.bulge_along_axis = nsvcd__v_load(block->bulge_along_axis + l);
  out.drift_along_axis = nsvcd__v_load(block->drift_along_axis + l);
  out.drift_off_way = nsvcd__v_load(block->drift_off_way + l);
  return out;
}
NSVCD__INLINE nsvcd__v nsvcd__v_deviation(const nsvcd__v_span *span, nsvcd__v3 n,
                                          float reach) {
  const nsvcd__v along = nsvcd__v_abs(nsvcd__v3_dot(n, span->axis));
  const nsvcd__v across = nsvcd__v3_length(nsvcd__v3_cross(n, span->axis));
  const nsvcd__v along_way = nsvcd__v_abs(nsvcd__v3_dot(n, span->way));
  const nsvcd__v across_way = nsvcd__v3_length(nsvcd__v3_cross(n, span->way));
  nsvcd__v by_axis = nsvcd__v_mul(across, span->drift);
  by_axis = nsvcd__v_fma(along, span->drift_along_axis, by_axis);
  nsvcd__v by_way = nsvcd__v_mul(across_way, span->drift_off_way);
  by_way = nsvcd__v_fma(along_way, span->drift, by_way);
  nsvcd__v turn = nsvcd__v_mul(across, span->bulge);
  turn = nsvcd__v_fma(along, span->bulge_along_axis, turn);
  return nsvcd__v_fma(turn, nsvcd__v_set(reach), nsvcd__v_min(by_axis, by_way));
}
#endif  // NSVCD_NO_PROOF
