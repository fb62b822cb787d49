// In: nothing. Out: do these vectors compute as they should?
#pragma once
#include "chords.h"

// The part of nsvcd_self_test that is about vectors: computes where a body's point (1, 0, 0) is at
// 16 ticks, while the body turns by 90 degrees about z from (4, 0, 0) to (-4, 0, 0), seen from a
// body at (1, 2, 3) whose x, y, z are y, z, x.
static int nsvcd__self_test_lanes(void) {
  // volatile, or the compiler would compute all this
  const volatile float half = 0.70710678f;
  const float turn = half;
  const nsvcd_pose path[2] = {{{4, 0, 0}, {0, 0, 0, 1}}, {{-4, 0, 0}, {0, 0, turn, turn}}};
  const nsvcd_pose rest = {{1, 2, 3}, {0.5f, 0.5f, 0.5f, 0.5f}};
  const nsvcd_mover moving = {NULL, path, 2, NULL, 0, {0}};
  const nsvcd_mover fixed = {NULL, &rest, 1, NULL, 0, {0}};
  nsvcd__chords chords;
  // A block, so that what comes after it shares its stack.
  {
    nsvcd__motion motion;
    nsvcd__keyframes keyframes;
    uint32_t ticks[NSVCD__LANES];
    for (uint32_t l = 0; l < NSVCD__LANES; l++) ticks[l] = l;
    nsvcd__motion_init(&moving, &fixed, &motion);
    nsvcd__motion_set_ticks(&motion, NSVCD__LANES);
    nsvcd__keyframes_read(&motion, ticks, NSVCD__LANES, &keyframes);
    NSVCD__EACH_SLICE(l) {
      const nsvcd__v_poses at = nsvcd__keyframes_load(&motion, &keyframes, l);
      const nsvcd__v_pose seen = nsvcd__v_seen(&motion, &at);
      const nsvcd__v3 arm = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
      const nsvcd__vmat3 rotation = nsvcd__vmat3_of(seen.rotation);
      const nsvcd__v3 start = nsvcd__vmat3_apply_add(rotation, arm, seen.position);
      const nsvcd__v3 travel = nsvcd__v3_set(nsvcd__f3_of(0, 0, -0.5f));
      nsvcd__chords_store(&chords, l, start, travel, nsvcd__v_set(0.1f));
    }
  }
  int right = 1;
  for (size_t l = 0; l < NSVCD__LANES; l++) {
    const double angle = 1.5707963267948966 * (double)l / NSVCD__LANES;
    const double x = 3 - 0.5 * (double)l + cos(angle);
    right &= fabs((double)chords.start[0][l] - (sin(angle) - 2)) < 1e-4;
    right &= fabs((double)chords.start[1][l] + 3) < 1e-4;
    right &= fabs((double)chords.start[2][l] - x) < 1e-4;
  }
  // Only two of these chords come within 0.2 of the ninth point.
  nsvcd__sphere resting = {{half - 2, -3, half - 1}, 0.1f};
  right &= nsvcd__meet(&chords, resting) == 0x180;
  resting.centre.y += 1;
  right &= nsvcd__meet(&chords, resting) == 0;
#ifdef NSVCD_ONE_PATH
  // A product is rounded. If it were fused with the difference, 2^-24 would be left.
  const volatile float one_up = 1 + 1.0f / 4096;
  const volatile float square = 1 + 1.0f / 2048;
  const float factor = one_up;
  const float left = factor * factor - square;
  right &= !(left > 0);
#endif
  return right;
}
