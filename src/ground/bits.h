// In: whole numbers, and floats. Out: bits that are set, sizes rounded up, floats as bits.
#pragma once
#include "compiler.h"

// The index of the lowest bit that is set, of a number that is not 0.
static size_t nsvcd__low_bit(uint64_t bits) {
#if defined(__GNUC__) || defined(__clang__)
  return (size_t)__builtin_ctzll(bits);
#else
  size_t n = 0;
  while (!(bits >> n & 1)) n++;
  return n;
#endif
}

static size_t nsvcd__bit_count(uint64_t bits) {
#if defined(__GNUC__) || defined(__clang__)
  return (size_t)__builtin_popcountll(bits);
#else
  size_t n = 0;
  for (; bits; bits &= bits - 1) n++;
  return n;
#endif
}

static size_t nsvcd__round_up(size_t n, size_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

// |x| as bits, which are ordered as |x| is; infinity and NaN are above all numbers.
static uint32_t nsvcd__magnitude(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits & 0x7fffffffu;
}
static inline int nsvcd__is_finite(float x) {
  return nsvcd__magnitude(x) < 0x7f800000u;
}
