// In: the samples of one patch, its centre, and the radius of its ball. Out: its latent
// (NSVCD__LATENT floats in (-1,1)): NSVCD_W_CHANNELS vectors of degree 1, as many of degree 2, and
// NSVCD_W_SCALARS invariants.
//
// A Vector-Neuron encoder (Deng et al. 2021) on features of degrees 1 and 2 (FER-VN, Son et al.
// 2024). Channels are mixed by matrices shared by all components, and the only nonlinearities are
// gates computed from invariants, so that turning the samples by R turns the latent by D(R).
// Dividing by the radius makes it independent of scale.
#pragma once
#include "../ground/points.h"
#include "model.h"

#ifndef NSVCD_NO_NETWORK
#ifndef NSVCD_NO_ENCODER
// Channels after pooling.
#define NSVCD__WIDE (NSVCD_W_POOLED + NSVCD_W_CONTEXT)
// Invariants of a sample.
#define NSVCD__INVARIANTS (2 + 5 * NSVCD_W_CONTEXT)
#define NSVCD__GATES (5 * NSVCD_W_POOLED + NSVCD_W_POOLED_SCALARS)
#define NSVCD__PATCH_IN (2 * NSVCD__WIDE + NSVCD_W_POOLED_SCALARS)
#define NSVCD__PATCH_OUT (2 * NSVCD_W_HIDDEN + NSVCD_W_SCALARS)

// A linear layer: y = w^T x + bias; w (inputs, outputs), bias (outputs) or NULL, x (inputs),
// y (outputs), which do not overlap. A sum of rows, which compilers vectorise.
static void nsvcd__linear(const float *w, const float *bias, size_t inputs, size_t outputs,
                          const float *x, float *y) {
  size_t left = inputs;
  for (size_t o = 0; o < outputs; o++) y[o] = bias ? bias[o] : 0;
  // four rows at a time: reading and writing y takes longest
  for (; left >= 4; left -= 4) {
    const float *r1 = w + outputs;
    const float *r2 = r1 + outputs;
    const float *r3 = r2 + outputs;
    const float x0 = x[0];
    const float x1 = x[1];
    const float x2 = x[2];
    const float x3 = x[3];
    for (size_t o = 0; o < outputs; o++)
      y[o] += (w[o] * x0 + r1[o] * x1) + (r2[o] * x2 + r3[o] * x3);
    w += 4 * outputs;
    x += 4;
  }
  for (; left > 0; left--) {
    for (size_t o = 0; o < outputs; o++) y[o] += w[o] * x[0];
    w += outputs;
    x++;
  }
}

static void nsvcd__relu(size_t count, float *x) {
  for (size_t i = 0; i < count; i++) x[i] = x[i] > 0 ? x[i] : 0;
}

// A vector of degree 2, in the basis of the real spherical harmonics xy, yz, zz, xz, xx-yy.
typedef struct nsvcd__f5 {
  float v[5];
} nsvcd__f5;

// Written out, for compilers that keep the five in memory if it is a loop.
static inline nsvcd__f5 nsvcd__f5_scale(nsvcd__f5 a, float s) {
  const float *v = a.v;
  const nsvcd__f5 out = {{s * v[0], s * v[1], s * v[2], s * v[3], s * v[4]}};
  return out;
}
// s b + a
static inline nsvcd__f5 nsvcd__f5_fma(float s, nsvcd__f5 b, nsvcd__f5 a) {
  const float *v = a.v;
  const float *w = b.v;
  const nsvcd__f5 out = {
      {v[0] + s * w[0], v[1] + s * w[1], v[2] + s * w[2], v[3] + s * w[3], v[4] + s * w[4]}};
  return out;
}
static inline float nsvcd__f5_dot(nsvcd__f5 a, nsvcd__f5 b) {
  const float *v = a.v;
  const float *w = b.v;
  return v[0] * w[0] + v[1] * w[1] + v[2] * w[2] + v[3] * w[3] + v[4] * w[4];
}

// The symmetric traceless part of a b^T, scaled so that the square of a vector has its squared
// length.
static nsvcd__f5 nsvcd__degree2(nsvcd__f3 a, nsvcd__f3 b) {
  const float half_root3 = 0.8660254037844386f;
  nsvcd__f5 q;
  q.v[0] = half_root3 * (a.x * b.y + a.y * b.x);
  q.v[1] = half_root3 * (a.y * b.z + a.z * b.y);
  q.v[2] = a.z * b.z - 0.5f * (a.x * b.x + a.y * b.y);
  q.v[3] = half_root3 * (a.x * b.z + a.z * b.x);
  q.v[4] = half_root3 * (a.x * b.x - a.y * b.y);
  return q;
}

// What the encoder sees of a patch.
typedef struct nsvcd__encoded {
  const nsvcd__f3 *samples, *normals;  // (count)
  size_t count;
  nsvcd__f3 centre;
  float inverse_radius;
} nsvcd__encoded;

// A sample's vectors of degree 1 and 2.
typedef struct nsvcd__feature {
  nsvcd__f3 u, n;           // position from the centre, over the radius; unit normal
  float uu, un;             // |u|^2, u.n
  nsvcd__f5 quu, qun, qnn;  // nsvcd__degree2 of both
} nsvcd__feature;

static nsvcd__feature nsvcd__feature_of(const nsvcd__encoded *patch, size_t i) {
  const nsvcd__f3 offset = nsvcd__f3_sub(patch->samples[i], patch->centre);
  nsvcd__feature f;
  f.u = nsvcd__f3_scale(offset, patch->inverse_radius);
  f.n = patch->normals[i];
  f.uu = nsvcd__f3_dot(f.u, f.u);
  f.un = nsvcd__f3_dot(f.u, f.n);
  f.quu = nsvcd__degree2(f.u, f.u);
  f.qun = nsvcd__degree2(f.u, f.n);
  f.qnn = nsvcd__degree2(f.n, f.n);
  return f;
}

// The channels of a patch: pooled ones, then the context.
typedef struct nsvcd__channels {
  nsvcd__f3 degree1[NSVCD__WIDE];
  nsvcd__f5 degree2[NSVCD__WIDE];
  float scalars[NSVCD_W_POOLED_SCALARS];
} nsvcd__channels;

// First pass: four moments of each degree, mixed into the context.
static void nsvcd__context(const nsvcd__encoded *patch, nsvcd__channels *out) {
  nsvcd__f3 m1[4] = {{0, 0, 0}};
  nsvcd__f5 m2[4] = {{{0, 0, 0, 0, 0}}};
  for (size_t i = 0; i < patch->count; i++) {
    const nsvcd__feature f = nsvcd__feature_of(patch, i);
    m1[0] = nsvcd__f3_add(m1[0], f.n);
    m1[1] = nsvcd__f3_fma(f.uu, f.n, m1[1]);
    m1[2] = nsvcd__f3_fma(f.un, f.u, m1[2]);
    m1[3] = nsvcd__f3_fma(f.uu, f.u, m1[3]);
    m2[0] = nsvcd__f5_fma(1, f.quu, m2[0]);
    m2[1] = nsvcd__f5_fma(1, f.qun, m2[1]);
    m2[2] = nsvcd__f5_fma(1, f.qnn, m2[2]);
    m2[3] = nsvcd__f5_fma(f.un, f.qun, m2[3]);
  }
  const float fraction = 1 / (float)patch->count;
  for (size_t c = 0; c < NSVCD_W_CONTEXT; c++) {
    nsvcd__f3 c1 = {0, 0, 0};
    nsvcd__f5 c2 = {{0, 0, 0, 0, 0}};
    for (size_t m = 0; m < 4; m++) {
      const float w1 = nsvcd_w_context1[m * NSVCD_W_CONTEXT + c];
      const float w2 = nsvcd_w_context2[m * NSVCD_W_CONTEXT + c];
      c1 = nsvcd__f3_fma(fraction, nsvcd__f3_scale(m1[m], w1), c1);
      c2 = nsvcd__f5_fma(fraction, nsvcd__f5_scale(m2[m], w2), c2);
    }
    out->degree1[NSVCD_W_POOLED + c] = c1;
    out->degree2[NSVCD_W_POOLED + c] = c2;
  }
}

// The sample network: a sample's invariants -> its gates (GATES).
static void nsvcd__gates(const nsvcd__feature *f, const nsvcd__channels *context,
                         float *gates) {
  const size_t hidden = NSVCD_W_POINT_HIDDEN;
  const nsvcd__f3 *c1 = context->degree1 + NSVCD_W_POOLED;
  const nsvcd__f5 *c2 = context->degree2 + NSVCD_W_POOLED;
  float x[NSVCD__INVARIANTS], h1[NSVCD_W_POINT_HIDDEN], h2[NSVCD_W_POINT_HIDDEN];
  x[0] = f->uu;
  x[1] = f->un;
  for (size_t c = 0; c < NSVCD_W_CONTEXT; c++) {
    float *to = x + 2 + c;
    to[0] = nsvcd__f3_dot(f->u, c1[c]);
    to[NSVCD_W_CONTEXT] = nsvcd__f3_dot(f->n, c1[c]);
    to[2 * NSVCD_W_CONTEXT] = nsvcd__f5_dot(f->quu, c2[c]);
    to[3 * NSVCD_W_CONTEXT] = nsvcd__f5_dot(f->qun, c2[c]);
    to[4 * NSVCD_W_CONTEXT] = nsvcd__f5_dot(f->qnn, c2[c]);
  }
  nsvcd__linear(nsvcd_w_point0, nsvcd_w_point0_bias, NSVCD__INVARIANTS, hidden, x, h1);
  nsvcd__relu(hidden, h1);
  nsvcd__linear(nsvcd_w_point1, nsvcd_w_point1_bias, hidden, hidden, h1, h2);
  nsvcd__relu(hidden, h2);
  nsvcd__linear(nsvcd_w_point2, nsvcd_w_point2_bias, hidden, NSVCD__GATES, h2, gates);
}

// The patch network: channels -> latent. The channels of each degree are mixed, gated, and mixed
// again.
static void nsvcd__finish_latent(const nsvcd__channels *a, float *latent) {
  const size_t hidden = NSVCD_W_PATCH_HIDDEN;
  float x[NSVCD__PATCH_IN], h[NSVCD_W_PATCH_HIDDEN], y[NSVCD__PATCH_OUT];
  for (size_t c = 0; c < NSVCD__WIDE; c++) {
    x[c] = nsvcd__f3_dot(a->degree1[c], a->degree1[c]);
    x[NSVCD__WIDE + c] = nsvcd__f5_dot(a->degree2[c], a->degree2[c]);
  }
  memcpy(x + 2 * NSVCD__WIDE, a->scalars, sizeof a->scalars);
  nsvcd__linear(nsvcd_w_patch0, nsvcd_w_patch0_bias, NSVCD__PATCH_IN, hidden, x, h);
  nsvcd__relu(hidden, h);
  nsvcd__linear(nsvcd_w_patch1, nsvcd_w_patch1_bias, hidden, NSVCD__PATCH_OUT, h, y);

  for (size_t degree = 1; degree <= 2; degree++) {
    const void *channels = degree == 1 ? (const void *)a->degree1 : (const void *)a->degree2;
    // (WIDE, size)
    const float *from = (const float *)channels;
    const float *mix = degree == 1 ? nsvcd_w_mix1 : nsvcd_w_mix2;
    const float *out = degree == 1 ? nsvcd_w_out1 : nsvcd_w_out2;
    const float *gates = y + NSVCD_W_HIDDEN * (degree - 1);
    const size_t size = 2 * degree + 1;
    for (size_t k = 0; k < size; k++) {
      float mixed[NSVCD__WIDE], gated[NSVCD_W_HIDDEN];
      for (size_t c = 0; c < NSVCD__WIDE; c++) mixed[c] = from[c * size + k];
      nsvcd__linear(mix, NULL, NSVCD__WIDE, NSVCD_W_HIDDEN, mixed, gated);
      for (size_t c = 0; c < NSVCD_W_HIDDEN; c++) gated[c] *= gates[c];
      float *z = latent + NSVCD_W_CHANNELS * k;
      nsvcd__linear(out, NULL, NSVCD_W_HIDDEN, NSVCD_W_CHANNELS, gated, z);
    }
    // shortened below length 1, so that int8 holds them
    for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
      float *z = latent + c;
      float square = 0;
      for (size_t k = 0; k < size; k++)
        square += z[NSVCD_W_CHANNELS * k] * z[NSVCD_W_CHANNELS * k];
      const float scale = 1 / sqrtf(1 + square);
      for (size_t k = 0; k < size; k++) z[NSVCD_W_CHANNELS * k] *= scale;
    }
    latent += NSVCD_W_CHANNELS * size;
  }
  const float *scalars = y + 2 * NSVCD_W_HIDDEN;
  for (size_t c = 0; c < NSVCD_W_SCALARS; c++) latent[c] = tanhf(scalars[c]);
}

// The latent (LATENT) of a patch of one or more samples: degree 1 (3, CHANNELS), degree 2 (5,
// CHANNELS), scalars.
static void nsvcd__encode_patch(const nsvcd__encoded *patch, float *latent) {
  const size_t pooled = NSVCD_W_POOLED;
  const float fraction = 1 / (float)patch->count;
  nsvcd__channels all;
  memset(&all, 0, sizeof all);
  nsvcd__context(patch, &all);
  for (size_t i = 0; i < patch->count; i++) {
    const nsvcd__feature f = nsvcd__feature_of(patch, i);
    float gates[NSVCD__GATES];
    nsvcd__gates(&f, &all, gates);
    for (size_t c = 0; c < pooled; c++) {
      const float *gate = gates + c;
      nsvcd__f3 a1 = nsvcd__f3_scale(f.u, gate[0]);
      a1 = nsvcd__f3_fma(gate[pooled], f.n, a1);
      nsvcd__f5 a2 = nsvcd__f5_scale(f.quu, gate[2 * pooled]);
      a2 = nsvcd__f5_fma(gate[3 * pooled], f.qun, a2);
      a2 = nsvcd__f5_fma(gate[4 * pooled], f.qnn, a2);
      all.degree1[c] = nsvcd__f3_fma(fraction, a1, all.degree1[c]);
      all.degree2[c] = nsvcd__f5_fma(fraction, a2, all.degree2[c]);
    }
    for (size_t c = 0; c < NSVCD_W_POOLED_SCALARS; c++)
      all.scalars[c] += gates[5 * pooled + c] * fraction;
  }
  nsvcd__finish_latent(&all, latent);
}
#endif  // NSVCD_NO_ENCODER
#endif  // NSVCD_NO_NETWORK
