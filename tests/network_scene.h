// network_scene.h - numbers, rotations and turned latents for the tests of the network. After the
// implementation.
#ifndef NSVCD_TESTS_NETWORK_SCENE_H
#define NSVCD_TESTS_NETWORK_SCENE_H

#include "arrays.h"
#include "data/golden.h"

static uint32_t network_seed = 1;

static float network_uniform(void) {  // [-1, 1)
  network_seed = network_seed * 1664525u + 1013904223u;
  return (float)(network_seed >> 8) / 8388608.0f - 1;
}

static void random_rotation(float *m) {
  float q[4];
  float length = 0;
  do {
    for (size_t k = 0; k < 4; k++) q[k] = network_uniform();
    length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  } while (length > 1 || length < 0.1f);
  for (size_t k = 0; k < 4; k++) q[k] /= length;
  matrix_of_quat(q, m);
}

static float largest_difference(const float *a, const float *b, size_t count) {
  float most = 0;
  for (size_t k = 0; k < count; k++) most = fmaxf(most, fabsf(a[k] - b[k]));
  return most;
}

// D(R) as floats: (9 + 25).
static void wigner(const float *r, float *d) {
  float lanes[NSVCD__WIGNER][NSVCD__SLICE];
  const nsvcd__mat3 rotation = {nsvcd__f3_load(r), nsvcd__f3_load(r + 3), nsvcd__f3_load(r + 6)};
  const nsvcd__vmat3 m = nsvcd__vmat3_set(&rotation);
  nsvcd__wigner(&m, nsvcd__v_set(1), lanes);
  for (size_t k = 0; k < NSVCD__WIGNER; k++) d[k] = lanes[k][3 % NSVCD__SLICE];
}

// D(R) z of a latent's vectors: (3, CHANNELS), then (5, CHANNELS).
static void rotate_latent(const float *r, const float *z, float *turned) {
  float d[NSVCD__WIGNER];
  wigner(r, d);
  for (size_t i = 0; i < 8; i++) {
    for (size_t c = 0; c < NSVCD_W_CHANNELS; c++) {
      float sum = 0;
      for (size_t k = 0; k < (i < 3 ? 3u : 5u); k++) {
        sum += d[i < 3 ? 3 * i + k : 9 + 5 * (i - 3) + k] *
               z[NSVCD_W_CHANNELS * ((i < 3 ? 0 : 3) + k) + c];
      }
      turned[NSVCD_W_CHANNELS * i + c] = sum;
    }
  }
}

#endif
