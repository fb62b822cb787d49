// In: a rotation R, and a latent. Out: the latent, turned by D(R).
//
// D(R) is block-diagonal: R on degree 1, and the real Wigner matrix on degree 2 (NeuralSVCD,
// appendix E). Its entries are polynomials of R's, so that D(R1 R2) = D(R1) D(R2) to rounding, and
// R may be improper (a mirror).
#pragma once
#include "../encoder/model.h"
#include "../lanes/turns.h"

#ifndef NSVCD_NO_NETWORK
// Numbers of a latent's vectors: (3, CHANNELS), then (5, CHANNELS).
#define NSVCD__VECTORS (8 * NSVCD_W_CHANNELS)
// Numbers of D: (3, 3), then (5, 5).
#define NSVCD__WIGNER 34
// The unit of a stored latent's numbers.
#define NSVCD__LATENT_STEP (1.0f / 127)

// nsvcd__degree2 of a and b, lane by lane: q (5).
static void nsvcd__v_degree2(nsvcd__v3 a, nsvcd__v3 b, nsvcd__v *q) {
  const nsvcd__v half = nsvcd__v_set(0.5f);
  const nsvcd__v half_root3 = nsvcd__v_set(0.8660254037844386f);
  const nsvcd__v xx = nsvcd__v_mul(a.x, b.x);
  const nsvcd__v yy = nsvcd__v_mul(a.y, b.y);
  const nsvcd__v zz = nsvcd__v_mul(a.z, b.z);
  const nsvcd__v xy = nsvcd__v_fma(a.x, b.y, nsvcd__v_mul(a.y, b.x));
  const nsvcd__v yz = nsvcd__v_fma(a.y, b.z, nsvcd__v_mul(a.z, b.y));
  const nsvcd__v xz = nsvcd__v_fma(a.x, b.z, nsvcd__v_mul(a.z, b.x));
  q[0] = nsvcd__v_mul(half_root3, xy);
  q[1] = nsvcd__v_mul(half_root3, yz);
  q[2] = nsvcd__v_sub(zz, nsvcd__v_mul(half, nsvcd__v_fma(a.x, b.x, yy)));
  q[3] = nsvcd__v_mul(half_root3, xz);
  q[4] = nsvcd__v_mul(half_root3, nsvcd__v_sub(xx, yy));
}

// D of a slice of matrices, lane by lane, times `scale`: out (WIGNER, SLICE). Column k of degree 2
// is the image of basis vector k, made of products of m's columns.
static NSVCD__NOINLINE void nsvcd__wigner(const nsvcd__vmat3 *m, nsvcd__v scale,
                                          float (*out)[NSVCD__SLICE]) {
  const nsvcd__v third = nsvcd__v_scale(scale, 1.0f / 3);
  const nsvcd__v root = nsvcd__v_scale(scale, 0.5773502691896258f);
  const nsvcd__v twice = nsvcd__v_add(root, root);
  const nsvcd__vmat3 c = nsvcd__vmat3_transpose(*m);
  nsvcd__v xy[5], yz[5], xz[5], xx[5], yy[5], zz[5];
  nsvcd__v3_put(nsvcd__v3_scale(m->x, scale), out[0], NSVCD__SLICE);
  nsvcd__v3_put(nsvcd__v3_scale(m->y, scale), out[3], NSVCD__SLICE);
  nsvcd__v3_put(nsvcd__v3_scale(m->z, scale), out[6], NSVCD__SLICE);
  nsvcd__v_degree2(c.x, c.y, xy);
  nsvcd__v_degree2(c.y, c.z, yz);
  nsvcd__v_degree2(c.x, c.z, xz);
  nsvcd__v_degree2(c.x, c.x, xx);
  nsvcd__v_degree2(c.y, c.y, yy);
  nsvcd__v_degree2(c.z, c.z, zz);
  for (size_t k = 0; k < 5; k++) {
    float(*row)[NSVCD__SLICE] = out + 9 + 5 * k;
    const nsvcd__v rest = nsvcd__v_add(xx[k], yy[k]);
    const nsvcd__v upright = nsvcd__v_sub(nsvcd__v_add(zz[k], zz[k]), rest);
    nsvcd__v_store(row[0], nsvcd__v_mul(twice, xy[k]));
    nsvcd__v_store(row[1], nsvcd__v_mul(twice, yz[k]));
    nsvcd__v_store(row[2], nsvcd__v_mul(third, upright));
    nsvcd__v_store(row[3], nsvcd__v_mul(twice, xz[k]));
    nsvcd__v_store(row[4], nsvcd__v_mul(root, nsvcd__v_sub(xx[k], yy[k])));
  }
}

// One degree: out (size, CHANNELS) = D (size * size, SLICE) of lane l, times latent (size,
// CHANNELS).
NSVCD__INLINE void nsvcd__rotate_degree(const float *latent, float (*turn)[NSVCD__SLICE],
                                        size_t l, size_t size, float *out) {
  for (size_t i = 0; i < size; i++) {
    float sum[NSVCD_W_CHANNELS] = {0};
    for (size_t k = 0; k < size; k++) {
      const float m = turn[size * i + k][l];
      for (size_t c = 0; c < NSVCD_W_CHANNELS; c++)
        sum[c] += m * latent[NSVCD_W_CHANNELS * k + c];
    }
    memcpy(out + NSVCD_W_CHANNELS * i, sum, sizeof sum);
  }
}

// Turns a stored latent by D (WIGNER, SLICE) of lane l, and writes it as latent `slot`, 0 or 1, of
// a row of the decoder's inputs: vectors (2, 8, CHANNELS), then scalars (2, SCALARS).
static NSVCD__O3 NSVCD__NOINLINE void nsvcd__rotate_latent(const int8_t *z,
                                                           float (*turn)[NSVCD__SLICE],
                                                           size_t l, size_t slot, float *row) {
  float *vectors = row + NSVCD__VECTORS * slot;
  float *scalars = row + 2 * NSVCD__VECTORS + NSVCD_W_SCALARS * slot;
  // one degree after the other: a query's stack is deepest here
  float degree[5 * NSVCD_W_CHANNELS];
  for (size_t k = 0; k < 3 * NSVCD_W_CHANNELS; k++) degree[k] = (float)z[k];
  nsvcd__rotate_degree(degree, turn, l, 3, vectors);
  z += 3 * NSVCD_W_CHANNELS;
  for (size_t k = 0; k < 5 * NSVCD_W_CHANNELS; k++) degree[k] = (float)z[k];
  nsvcd__rotate_degree(degree, turn + 9, l, 5, vectors + 3 * NSVCD_W_CHANNELS);
  z += 5 * NSVCD_W_CHANNELS;
  for (size_t k = 0; k < NSVCD_W_SCALARS; k++) scalars[k] = (float)z[k] * NSVCD__LATENT_STEP;
}
#endif  // NSVCD_NO_NETWORK
