// The encoder: parity with the trainer, and equivariance.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/encoder/encoder.h"
#include "../src/network/latent_rotation.h"

#include "arrays.h"
#include "check.h"
#include "network_scene.h"

void test_encoder(void);

// The latent of a patch of `count` samples; points, normals: (count, 3).
static void encode_patch(const float *points, const float *normals, size_t count,
                         const float *centre, float radius, float *latent) {
  nsvcd__encoded patch;
  patch.samples = (const nsvcd__f3 *)(const void *)points;
  patch.normals = (const nsvcd__f3 *)(const void *)normals;
  patch.count = count;
  patch.centre = nsvcd__f3_load(centre);
  patch.inverse_radius = 1 / radius;
  nsvcd__encode_patch(&patch, latent);
}

static void encoder_matches_the_trainer(void) {
  for (size_t i = 0; i < GOLDEN_PATCHES; i++) {
    float latent[NSVCD__LATENT];
    encode_patch(golden_points + 3 * GOLDEN_POINTS * i, golden_normals + 3 * GOLDEN_POINTS * i,
                 GOLDEN_POINTS, golden_centre + 3 * i, golden_radius[i], latent);
    CHECK_LE(largest_difference(latent, golden_latent + NSVCD__LATENT * i, NSVCD__LATENT), 1e-4);
  }
}

// Random oriented points in the unit ball about a random centre.
static void random_patch(float *points, float *normals, size_t count) {
  float lean[3] = {network_uniform(), network_uniform(), network_uniform()};
  for (size_t i = 0; i < count; i++) {
    float n[3], length;
    for (size_t k = 0; k < 3; k++) {
      points[3 * i + k] = 0.57f * network_uniform();
      n[k] = network_uniform() + lean[k];
    }
    length = length3(n);
    for (size_t k = 0; k < 3; k++) normals[3 * i + k] = n[k] / length;
  }
}

static void encoder_is_equivariant(void) {
  for (int trial = 0; trial < 100; trial++) {
    float points[3 * 40], normals[3 * 40], turned_points[3 * 40], turned_normals[3 * 40], m[9];
    float latent[NSVCD__LATENT];
    float expected[NSVCD__LATENT];
    float turned[NSVCD__LATENT];
    float zero[3] = {0, 0, 0};
    float centre[3];
    random_patch(points, normals, 40);
    random_rotation(m);
    if (trial % 2) {  // mirrored as well: the degree-2 block is even, degree 1 odd
      for (size_t k = 0; k < 9; k++) m[k] = -m[k];
    }
    const float scale = powf(10, 3 * network_uniform());
    for (size_t k = 0; k < 3; k++) centre[k] = scale * network_uniform();
    for (size_t i = 0; i < 40; i++) {
      mul33_vec(m, points + 3 * i, turned_points + 3 * i);
      mul33_vec(m, normals + 3 * i, turned_normals + 3 * i);
      for (size_t k = 0; k < 3; k++)
        turned_points[3 * i + k] = scale * turned_points[3 * i + k] + centre[k];
    }
    encode_patch(points, normals, 40, zero, 1, latent);
    encode_patch(turned_points, turned_normals, 40, centre, scale, turned);
    rotate_latent(m, latent, expected);
    memcpy(expected + NSVCD__VECTORS, latent + NSVCD__VECTORS, NSVCD_W_SCALARS * sizeof(float));
    // float32, and gates that amplify
    CHECK_LE(largest_difference(turned, expected, NSVCD__LATENT), 2e-4);
    CHECK_GE(largest_difference(latent, turned, NSVCD__LATENT), 1e-3);  // it does depend on R
  }
}

void test_encoder(void) {
  RUN(encoder_matches_the_trainer);
  RUN(encoder_is_equivariant);
}

CHECK_ALONE(test_encoder)
