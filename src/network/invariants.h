// In: pairs of patches in motion. Out: the decoder's inputs, invariants (n, DECODER_IN).
//
// All is expressed in a frame that moves with the pair, in units of r1 + r2 (NeuralSVCD, appendix
// F), so that the logit is invariant to rigid motion and scale. The other symmetries are not
// learned, but removed by conventions:
//   swap           the larger patch comes first
//   axis 1         the line between the centres
//   axis 2         the velocity across the line, plus a twentieth of the lean (the difference of
//                  the patches' normals), so that it has a limit where the velocity vanishes
//   time reversal  time runs so that velocity and lean, across the line, do not oppose each other
//   mirror         axis 3 points to the side of the lean; if the lean is on neither side, as for a
//                  pair at rest, the frame is right-handed
// Degenerate cases: if the centres coincide (to 1e-5 of r1 + r2), axis 1 is the lean, else x; if
// the reference for axis 2 vanishes, that is the coordinate axis farthest from axis 1.
//
// Pairs become inputs a slice at a time, one per lane; only latents are turned pair by pair,
// channels side by side.
#pragma once
#include "../task/facts.h"
#include "latent_rotation.h"
#include "pairs.h"

#ifndef NSVCD_NO_NETWORK
// A lean that is this near to the plane of axes 1 and 2 is on neither side.
#define NSVCD__SIDE 1e-4f

// ---- frames and facts

// Pairs in their own units, in the fixed body's axes, and their frames.
typedef struct nsvcd__views {
  nsvcd__v inverse, k1, k2;  // 1 / (r1 + r2), and the radii
  nsvcd__v swap;             // -1 if the fixed patch is the larger, else 1
  nsvcd__v3 d;               // from the larger patch's centre to the smaller one's
  nsvcd__v3 lean;
  nsvcd__v3 normal;    // the moving patch's
  nsvcd__v time;       // -1 if time runs backwards, else 1
  nsvcd__v3 v, w;      // the larger patch's motion, as time runs
  nsvcd__vmat3 frame;  // its rows are the axes
  nsvcd__v side;       // -1 if mirrored, else 1
} nsvcd__views;

// a without its part along the unit vector e.
static nsvcd__v3 nsvcd__v_across(nsvcd__v3 a, nsvcd__v3 e) {
  return nsvcd__v3_fma(nsvcd__v_negate(nsvcd__v3_dot(a, e)), e, a);
}

// x where a <= b, elsewhere y.
static nsvcd__v3 nsvcd__v3_pick(nsvcd__v a, nsvcd__v b, nsvcd__v3 x, nsvcd__v3 y) {
  return nsvcd__v3_of(nsvcd__v_pick(a, b, x.x, y.x), nsvcd__v_pick(a, b, x.y, y.y),
                      nsvcd__v_pick(a, b, x.z, y.z));
}

// a over its length where that exceeds `least`, elsewhere `instead`.
static nsvcd__v3 nsvcd__v_unit_or(nsvcd__v3 a, float least, nsvcd__v3 instead) {
  const nsvcd__v length = nsvcd__v3_norm(a);
  const nsvcd__v floor = nsvcd__v_set(least);
  const nsvcd__v inverse = nsvcd__v_div(nsvcd__v_set(1), nsvcd__v_max(length, floor));
  return nsvcd__v3_pick(length, floor, instead, nsvcd__v3_scale(a, inverse));
}

static NSVCD__NOINLINE void nsvcd__views_of(const nsvcd__pairs *p, nsvcd__views *view) {
  const nsvcd__v one = nsvcd__v_set(1);
  const nsvcd__v minus = nsvcd__v_set(-1);
  const nsvcd__v3 between = nsvcd__v3_sub(p->p2, p->p1);
  // The unit of length: r1 + r2, or, between two points, what keeps the inputs finite.
  const nsvcd__v lengths = nsvcd__v_add(nsvcd__v3_norm(between), nsvcd__v3_norm(p->v));
  const nsvcd__v least = nsvcd__v_fma(nsvcd__v_set(1e-6f), lengths, nsvcd__v_set(1e-30f));
  const nsvcd__v unit = nsvcd__v_max(nsvcd__v_add(p->r1, p->r2), least);
  const nsvcd__v inverse = nsvcd__v_div(one, unit);
  view->inverse = inverse;
  view->k1 = nsvcd__v_mul(p->r1, inverse);
  view->k2 = nsvcd__v_mul(p->r2, inverse);
  view->swap = nsvcd__v_pick(p->r2, p->r1, one, minus);
  // The larger patch's motion changes its sign with `swap`, and again with `time`: in all with
  // `sign` below.
  view->normal = nsvcd__vmat3_apply(p->rotation, p->normal[0]);
  const nsvcd__v3 lean1 = nsvcd__v3_scale(view->normal, view->k1);
  const nsvcd__v3 lean2 = nsvcd__v3_scale(p->normal[1], view->k2);
  const nsvcd__v3 lean = nsvcd__v3_scale(nsvcd__v3_sub(lean1, lean2), view->swap);
  const nsvcd__v3 v = nsvcd__v3_scale(p->v, inverse);
  view->lean = lean;
  view->d = nsvcd__v3_scale(nsvcd__v3_scale(between, inverse), view->swap);

  // the frames, and the direction of time
  const nsvcd__v3 x_axis = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v3 line = nsvcd__v3_of(nsvcd__v_plus(lean.x, 1e-6f), lean.y, lean.z);
  nsvcd__v3 instead = nsvcd__v_unit_or(line, 1e-9f, x_axis);
  const nsvcd__v3 e1 = nsvcd__v_unit_or(view->d, 1e-5f, instead);
  const nsvcd__v3 lean_across = nsvcd__v_across(lean, e1);
  const nsvcd__v3 v_across = nsvcd__v_across(v, e1);
  const nsvcd__v sign = nsvcd__v_sign(nsvcd__v3_dot(lean_across, v_across));
  view->time = nsvcd__v_mul(sign, view->swap);
  view->v = nsvcd__v3_scale(v, sign);
  view->w = nsvcd__v3_scale(p->w, sign);
  const nsvcd__v3 forward = nsvcd__v3_scale(v_across, sign);
  const nsvcd__v3 ref = nsvcd__v3_fma(nsvcd__v_set(NSVCD__LEAN), lean_across, forward);
  // if the reference vanishes in some lane: the coordinate axis farthest from e1
  if (nsvcd__v_le(nsvcd__v3_norm(ref), nsvcd__v_set(1e-7f))) {
    const nsvcd__v3 y_axis = nsvcd__v3_set(nsvcd__f3_of(0, 1, 0));
    const nsvcd__v3 z_axis = nsvcd__v3_set(nsvcd__f3_of(0, 0, 1));
    const nsvcd__v3 size = nsvcd__v3_max(e1, nsvcd__v3_negate(e1));
    const nsvcd__v rest = nsvcd__v_min(size.y, size.z);
    const nsvcd__v3 y_or_z = nsvcd__v3_pick(size.y, size.z, y_axis, z_axis);
    const nsvcd__v3 axis = nsvcd__v3_pick(size.x, rest, x_axis, y_or_z);
    instead = nsvcd__v_unit_or(nsvcd__v_across(axis, e1), 1e-9f, x_axis);
  }
  const nsvcd__v3 e2 = nsvcd__v_unit_or(ref, 1e-7f, instead);
  const nsvcd__v3 e3 = nsvcd__v3_cross(e1, e2);
  const nsvcd__v beside = nsvcd__v3_dot(lean, e3);
  view->side = nsvcd__v_pick(nsvcd__v_set(-NSVCD__SIDE), beside, one, minus);
  view->frame.x = e1;
  view->frame.y = e2;
  view->frame.z = nsvcd__v3_scale(e3, view->side);
}

// ---- gaps

// The axes u (GAPS) along which gaps are measured.
static void nsvcd__gap_axes_of(const nsvcd__pairs *p, const nsvcd__views *view, nsvcd__v3 *u) {
  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v3 between = nsvcd__v3_sub(p->p1, p->p2);
  const nsvcd__v3 x_axis = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v3 line = nsvcd__v_unit_or(between, 1e-20f, x_axis);
  const nsvcd__v3 fixed = nsvcd__v_unit_or(p->normal[1], 0.5f, line);
  const nsvcd__v3 moving = nsvcd__v_unit_or(nsvcd__v3_negate(view->normal), 0.5f, line);
  u[NSVCD__GAP_LARGER] = nsvcd__v3_pick(zero, view->swap, moving, fixed);
  u[NSVCD__GAP_SMALLER] = nsvcd__v3_pick(zero, view->swap, fixed, moving);
  u[NSVCD__GAP_LINE] = line;
  u[NSVCD__GAP_BOTH] = nsvcd__v_unit_or(nsvcd__v3_add(fixed, moving), 1e-3f, line);
}

// The extreme points of the first `count` pairs of a slice, of the moving patches and of the fixed
// ones: (2, EXTREMES, 3, SLICE), from the centres, in the bodies' frames, in 1/127 of the radii.
static void nsvcd__extremes_collect(const nsvcd__pairs *p, size_t count, int8_t *extremes) {
  memset(extremes, 0, 2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE);
  for (size_t n = 0; n < 2; n++) {
    for (size_t k = 0; k < 3 * NSVCD__EXTREMES; k++, extremes += NSVCD__SLICE) {
      for (size_t l = 0; l < count; l++) extremes[l] = p->extremes[n][l][NSVCD__GROUP * k];
    }
  }
}

// The direction u as seen from a patch that turns by w, to the second order: its dot product with q
// is u . (q + w x q + w x (w x q) / 2).
static nsvcd__v3 nsvcd__turned_back(nsvcd__v3 u, nsvcd__v3 w) {
  const nsvcd__v along = nsvcd__v_scale(nsvcd__v3_dot(u, w), 0.5f);
  const nsvcd__v less = nsvcd__v_scale(nsvcd__v3_dot(w, w), -0.5f);
  const nsvcd__v3 turned = nsvcd__v3_add(nsvcd__v3_cross(u, w), u);
  return nsvcd__v3_fma(less, u, nsvcd__v3_fma(along, w, turned));
}

// The gaps along the axes u at tau, wide (GAPS), in the fixed body's units; the interval's ends are
// -1 and 1. Seen from a frame that turns half as fast as the moving patch, so that both patches are
// treated alike: the line between the centres moves by v, one patch turns by w / 2, the other by
// -w / 2. extremes: of nsvcd__extremes_collect.
static NSVCD__NOINLINE void nsvcd__gaps_at(const nsvcd__pairs *p, const nsvcd__v3 *u,
                                           const int8_t *extremes, nsvcd__v tau,
                                           nsvcd__v *wide) {
  const size_t size = 3 * NSVCD__SLICE;
  const nsvcd__v3 half = nsvcd__v3_scale(p->w, nsvcd__v_scale(tau, 0.5f));
  const nsvcd__v3 back = nsvcd__v3_negate(half);
  nsvcd__v3 own[NSVCD__GAPS], other[NSVCD__GAPS];
  nsvcd__v low[NSVCD__GAPS], high[NSVCD__GAPS];
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__v3 turned = nsvcd__turned_back(u[d], half);
    own[d] = nsvcd__vmat3_apply_transpose(p->rotation, turned);
    other[d] = nsvcd__turned_back(u[d], back);
    low[d] = nsvcd__v_set(1e30f);
    high[d] = nsvcd__v_set(-1e30f);
  }
  for (size_t k = 0; k < NSVCD__EXTREMES; k++, extremes += size) {
    const nsvcd__v3 q = nsvcd__v3_load_int8(extremes, NSVCD__SLICE);
    const nsvcd__v3 x = nsvcd__v3_load_int8(extremes + NSVCD__EXTREMES * size, NSVCD__SLICE);
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      low[d] = nsvcd__v_min(low[d], nsvcd__v3_dot(own[d], q));
      high[d] = nsvcd__v_max(high[d], nsvcd__v3_dot(other[d], x));
    }
  }
  const nsvcd__v3 between = nsvcd__v3_sub(p->p1, p->p2);
  const nsvcd__v3 line = nsvcd__v3_fma(tau, p->v, between);
  const nsvcd__v step1 = nsvcd__v_scale(p->r1, 1.0f / 127);
  const nsvcd__v step2 = nsvcd__v_scale(p->r2, 1.0f / 127);
  for (size_t d = 0; d < NSVCD__GAPS; d++) {
    const nsvcd__v above = nsvcd__v_fma(step1, low[d], nsvcd__v3_dot(u[d], line));
    wide[d] = nsvcd__v_sub(above, nsvcd__v_mul(step2, high[d]));
  }
}

// The fact about a gap.
static nsvcd__v nsvcd__gap_fact(nsvcd__v gap, float steep) {
  const nsvcd__v x = nsvcd__v_scale(gap, steep);
  return nsvcd__v_div(x, nsvcd__v_plus(nsvcd__v_abs(x), 1));
}

// Writes the facts about gaps.
static NSVCD__NOINLINE void nsvcd__gap_facts(const nsvcd__pairs *p, const nsvcd__views *view,
                                             size_t count, float (*facts)[NSVCD__SLICE]) {
  int8_t extremes[2 * 3 * NSVCD__EXTREMES * NSVCD__SLICE];
  nsvcd__v3 u[NSVCD__GAPS];
  nsvcd__gap_axes_of(p, view, u);
  nsvcd__extremes_collect(p, count, extremes);
  for (size_t m = 0; m < NSVCD__MOMENTS; m++) {
    const nsvcd__v tau = nsvcd__v_scale(view->time, (float)m - 1);
    nsvcd__v wide[NSVCD__GAPS];
    nsvcd__v widest = nsvcd__v_set(-1e30f);
    nsvcd__gaps_at(p, u, extremes, tau, wide);
    for (size_t d = 0; d < NSVCD__GAPS; d++) {
      const nsvcd__v gap = nsvcd__v_mul(view->inverse, wide[d]);
      float *to = facts[NSVCD__FACT_GAPS + NSVCD__MOMENTS * d + m];
      nsvcd__v_store(to, nsvcd__gap_fact(gap, NSVCD__GAP_STEEP));
      widest = nsvcd__v_max(widest, gap);
    }
    nsvcd__v_store(facts[NSVCD__FACT_WIDEST + m],
                   nsvcd__gap_fact(widest, NSVCD__WIDEST_STEEP));
  }
}

// ---- inputs

// What inputs for a slice of pairs are made of, besides the latents.
typedef struct nsvcd__inputs {
  // of the moving patches and of the fixed ones:
  nsvcd__vmat3 turn[2];  // from their bodies' frames to the pairs'
  nsvcd__v k[2];         // radii, in the pairs' units
  uint32_t keep;         // lanes in which the moving patch is the larger
  float facts[NSVCD__FACTS][NSVCD__SLICE];
} nsvcd__inputs;

// All of that but for the facts about gaps.
static NSVCD__NOINLINE void nsvcd__inputs_without_gaps(const nsvcd__pairs *p,
                                                       const nsvcd__views *view,
                                                       nsvcd__inputs *out) {
  out->turn[0] = nsvcd__vmat3_mul(view->frame, p->rotation);
  out->turn[1] = view->frame;
  out->k[0] = view->k1;
  out->k[1] = view->k2;
  out->keep = nsvcd__v_le(nsvcd__v_set(0), view->swap);

  const nsvcd__v speed2 = nsvcd__v3_dot(view->v, view->v);
  const nsvcd__v above = nsvcd__v_plus(speed2, 1e-6f);
  // the time of the centres' closest approach, in half intervals
  const nsvcd__v when = nsvcd__v_div(nsvcd__v3_dot(view->d, view->v), above);
  const nsvcd__v tau = nsvcd__v_clamp(when, -1, 1);
  const nsvcd__v3 closest = nsvcd__v3_sub(view->d, nsvcd__v3_scale(view->v, tau));
  const nsvcd__v3 velocity = nsvcd__vmat3_apply(view->frame, view->v);
  const nsvcd__v3 turn = nsvcd__vmat3_apply(view->frame, view->w);
  // the turn is an axial vector
  const nsvcd__v3 mirrored = nsvcd__v3_scale(turn, view->side);

  float(*facts)[NSVCD__SLICE] = out->facts;
  nsvcd__v_store(facts[NSVCD__FACT_DISTANCE], nsvcd__v3_norm(view->d));
  nsvcd__v_store(facts[NSVCD__FACT_RADIUS], nsvcd__v_max(view->k1, view->k2));
  nsvcd__v_store(facts[NSVCD__FACT_CLOSEST], nsvcd__v3_norm(closest));
  nsvcd__v_store(facts[NSVCD__FACT_TAU], tau);
  nsvcd__v3_put(velocity, facts[NSVCD__FACT_VELOCITY], NSVCD__SLICE);
  nsvcd__v3_put(mirrored, facts[NSVCD__FACT_TURN], NSVCD__SLICE);
  nsvcd__v_store(facts[NSVCD__FACT_SPEED], nsvcd__v_sqrt(speed2));
  nsvcd__v_store(facts[NSVCD__FACT_SPIN], nsvcd__v3_norm(view->w));

  const nsvcd__v zero = nsvcd__v_set(0);
  const nsvcd__v3 *fixed = &p->normal[1];
  const nsvcd__v3 larger = nsvcd__v3_pick(zero, view->swap, view->normal, *fixed);
  const nsvcd__v3 smaller = nsvcd__v3_pick(zero, view->swap, *fixed, view->normal);
  float(*facing)[NSVCD__SLICE] = facts + NSVCD__FACT_FACING;
  nsvcd__v_store(facing[0], nsvcd__v3_dot(larger, smaller));
  nsvcd__v_store(facing[1], nsvcd__v3_dot(larger, view->frame.x));
  nsvcd__v_store(facing[2], nsvcd__v3_dot(smaller, view->frame.x));
  float(*flat)[NSVCD__SLICE] = facts + NSVCD__FACT_FLAT;
  nsvcd__v_store(flat[0], nsvcd__v_pick(zero, view->swap, p->flat[0], p->flat[1]));
  nsvcd__v_store(flat[1], nsvcd__v_pick(zero, view->swap, p->flat[1], p->flat[0]));
}

// For the first `count` pairs of a slice. Step by step, so that the stack of one step does not add
// to that of the next.
static void nsvcd__inputs_of(const nsvcd__pairs *p, size_t count, nsvcd__inputs *out) {
  nsvcd__views view;
  nsvcd__views_of(p, &view);
  nsvcd__inputs_without_gaps(p, &view, out);
  nsvcd__gap_facts(p, &view, count, out->facts);
}

// Writes the decoder's inputs for the first `count` pairs of a slice, x (count, DECODER_IN): the
// vectors of the larger patch and of the smaller one, their scalars, and the facts.
static NSVCD__NOINLINE void nsvcd__inputs_write(const nsvcd__inputs *in, const nsvcd__pairs *p,
                                                size_t count, float *x) {
  const nsvcd__v step = nsvcd__v_set(NSVCD__LATENT_STEP);
  float wigner[NSVCD__WIGNER][NSVCD__SLICE];
  for (size_t n = 0; n < 2; n++) {
    nsvcd__wigner(&in->turn[n], nsvcd__v_mul(in->k[n], step), wigner);
    for (size_t l = 0; l < count; l++) {
      const size_t slot = (in->keep >> l & 1) == n;
      nsvcd__rotate_latent(p->z[n][l], wigner, l, slot, x + NSVCD__DECODER_IN * l);
    }
  }
  for (size_t l = 0; l < count; l++) {
    float *facts = x + NSVCD__DECODER_IN * l + 2 * NSVCD__LATENT;
    for (size_t k = 0; k < NSVCD__DECODER_IN - 2 * NSVCD__LATENT; k++)
      facts[k] = k < NSVCD__FACTS ? in->facts[k][l] : 0;
  }
}

static NSVCD__NOINLINE void nsvcd__invariants(const nsvcd__pairs *p, size_t count, float *x) {
  nsvcd__inputs inputs;
  nsvcd__inputs_of(p, count, &inputs);
  nsvcd__inputs_write(&inputs, p, count, x);
}
#endif  // NSVCD_NO_NETWORK
