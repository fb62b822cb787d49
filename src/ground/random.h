// In: a state. Out: random numbers, the same from the same state.
#pragma once
#include "../interface/options.h"

// Splitmix64, in (0, 1].
static inline double nsvcd__random(uint64_t *state) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((z ^ (z >> 31)) >> 11) * 1.1102230246251565e-16 + 5.5e-17;
}
