// Latents turned by a rotation: the group laws of D(R).
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/network/latent_rotation.h"

#include "arrays.h"
#include "check.h"
#include "network_scene.h"

void test_latent_rotation(void);

static void rotation_operator_is_a_group(void) {
  const float half_turn[9] = {-1, 0, 0, 0, -1, 0, 0, 0, 1};
  for (int trial = 0; trial < 200; trial++) {
    float a[9], b[9], ab[9], z[NSVCD__VECTORS], x[NSVCD__VECTORS], y[NSVCD__VECTORS],
        w[NSVCD__VECTORS];
    random_rotation(a);
    random_rotation(b);
    mul33(a, b, ab);
    for (size_t k = 0; k < NSVCD__VECTORS; k++) z[k] = network_uniform();
    rotate_latent(b, z, x);
    rotate_latent(a, x, y);
    rotate_latent(ab, z, w);
    CHECK_LE(largest_difference(y, w, NSVCD__VECTORS), 3e-6);  // D(A) D(B) = D(AB)
    rotate_latent(half_turn, z, x);
    CHECK_GE(largest_difference(x, z, NSVCD__VECTORS), 0.1);
    rotate_latent(half_turn, x, y);
    CHECK_LE(largest_difference(y, z, NSVCD__VECTORS), 1e-6);  // twice 180 degrees is the identity
    float back[9];
    transpose33(a, back);
    rotate_latent(a, z, x);
    rotate_latent(back, x, y);
    CHECK_LE(largest_difference(y, z, NSVCD__VECTORS), 2e-6);  // D(R)^T is the inverse
  }
}

void test_latent_rotation(void) {
  RUN(rotation_operator_is_a_group);
}

CHECK_ALONE(test_latent_rotation)
