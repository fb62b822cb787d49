// What is inside of what, for the network.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/network/winding_number.h"

#include "arrays.h"
#include "check.h"
#include "random_bodies.h"

void test_winding_number(void);

static int is_contained(const nsvcd_body *moving, const nsvcd_body *fixed, const float *rotation,
                        const float *position) {
  nsvcd__transform pose;
  pose.rotation.x = nsvcd__f3_load(rotation);
  pose.rotation.y = nsvcd__f3_load(rotation + 3);
  pose.rotation.z = nsvcd__f3_load(rotation + 6);
  pose.position = nsvcd__f3_load(position);
  return nsvcd__is_contained(moving, fixed, 1, &pose);
}

static void containment(void) {
  const float eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  // of the winding number, by distance: 0.75-1, 1-1.5, 1.5-2, over 2 radii
  double error[4] = {0, 0, 0, 0};
  size_t clear = 0;
  size_t rough = 0;  // places from NSVCD__FAR_ENOUGH on, and those whose error exceeds 0.3
  for (size_t points = 32; points <= 512; points *= 2) {
    const nsvcd_body *outer = shell_body(points, 1, &blob_a_memory);
    const nsvcd_body *inner = shell_body(64, 0.1, &blob_b_memory);
    double r = (double)nsvcd__body_r(outer)[0];
    for (int n = 0; n < 2000; n++) {
      float q[4];
      float rotation[9];
      float at[3] = {0, 0, 0};
      float way[3];
      random_quat(q);
      normalize_quat(q, q);
      matrix_of_quat(q, rotation);
      double distance = uniform(0, 2);
      for (int k = 0; k < 3; k++) {
        way[k] = rotation[3 * k];
        at[k] = (float)distance * way[k];
      }
      nsvcd__probes places;
      for (int k = 0; k < 3 * NSVCD__PROBES; k++)
        places.at[k / NSVCD__PROBES][k % NSVCD__PROBES] = at[k / NSVCD__PROBES];
      nsvcd__probes_measure(outer, &places);
      double in_radii = sqrt((double)places.square[7]);
      int bin = in_radii < 1 ? 0 : in_radii < 1.5 ? 1 : in_radii < 2 ? 2 : 3;
      double want = distance < 1 ? 1 : 0;
      double off = fabs((double)nsvcd__winding_number(outer, nsvcd__f3_load(at)) - want);
      if (in_radii >= 0.75) error[bin] = fmax(error[bin], off);
      clear += in_radii >= (double)NSVCD__FAR_ENOUGH;
      rough += in_radii >= (double)NSVCD__FAR_ENOUGH && off > 0.3;
      // In the clear: exactly when it is inside. On the surface: anything. Outside: never.
      if (distance < 1 - 0.1 - r) CHECK(is_contained(inner, outer, rotation, at));
      if (distance < 1 - 0.1 - r) {
        float back[9], from[3];
        transpose33(rotation, back);
        mul33_vec(back, at, from);
        for (int k = 0; k < 3; k++) from[k] = -from[k];
        CHECK(is_contained(outer, inner, back, from));
      }
      if (distance > 1.1) CHECK(!is_contained(inner, outer, rotation, at));
    }
    const float far[3] = {30, 0, 0};
    const float none[3] = {0, 0, 0};
    CHECK(!is_contained(inner, outer, eye, far));
    CHECK(is_contained(inner, outer, eye, none));
  }
  printf(
      "  winding number, worst error from 0.75 / 1 / 1.5 / 2 patch radii on: %.3f %.3f %.3f %.4f; "
      "over 0.3: %zu of "
      "%zu\n",
      error[0], error[1], error[2], error[3], rough, clear);
  CHECK_GE(clear, 5000);
  CHECK_LE(rough, clear / 1000);  // from NSVCD__FAR_ENOUGH on; a verdict turns at 0.5
  CHECK_LE(error[3], 0.02);
}

// A hollow ball (two shells, the inner one turned inside out): its cavity is outside.
static void containment_in_a_cavity(void) {
  const float eye[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  shell_body(256, 0.6, &blob_a_memory);
  float inner_centres[3 * 256], inner_areas[3 * 256], inner_radii[256];
  memcpy(inner_centres, centres, sizeof inner_centres);
  memcpy(inner_areas, areas, sizeof inner_areas);
  memcpy(inner_radii, radii, sizeof inner_radii);
  shell_body(256, 1, &blob_a_memory);
  for (size_t n = 0; n < 3 * 256; n++) {
    centres[3 * 256 + n] = inner_centres[n];
    areas[3 * 256 + n] = -inner_areas[n];
  }
  for (size_t n = 0; n < 256; n++) radii[256 + n] = inner_radii[n];
  const nsvcd_body *hollow = build(512, &blob_a_memory);
  const nsvcd_body *ball = shell_body(32, 0.02, &blob_b_memory);
  const float middle[3] = {0, 0, 0};
  const float wall[3] = {0, 0.8f, 0};
  const float outside[3] = {1.4f, 0, 0};
  CHECK(!is_contained(ball, hollow, eye, middle));
  CHECK(is_contained(ball, hollow, eye, wall));
  CHECK(!is_contained(ball, hollow, eye, outside));
}

void test_winding_number(void) {
  RUN(containment);
  RUN(containment_in_a_cavity);
}

CHECK_ALONE(test_winding_number)
