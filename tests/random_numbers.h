// random_numbers.h - random numbers, sizes and unit quaternions. Deterministic.
#ifndef NSVCD_TESTS_RANDOM_NUMBERS_H
#define NSVCD_TESTS_RANDOM_NUMBERS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

static uint64_t rng_state = 1;

static double uniform(double low, double high) {  // splitmix64 (Vigna)
  uint64_t x = (rng_state += 0x9e3779b97f4a7c15u);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  x ^= x >> 31;
  return low + (high - low) * (double)(x >> 11) / 9007199254740992.0;
}

static size_t pick(size_t low, size_t high) {
  return low + (size_t)uniform(0, (double)(high - low + 1));
}

static void random_quat(float *q) {
  double v[4];
  double square = 0;
  do {
    square = 0;
    for (int k = 0; k < 4; k++) {
      v[k] = uniform(-1, 1);
      square += v[k] * v[k];
    }
  } while (square > 1 || square < 0.01);
  for (int k = 0; k < 4; k++) q[k] = (float)(v[k] / sqrt(square));
}

#endif
