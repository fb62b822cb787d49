// lanes.h - 16 floats at a time: children of a node, triangles of a leaf, or axes.
// In: nothing. Out: `lanes` and the handful of operations that the proof needs. Sums and products
// are the compiler's own (vector_size); minima, comparisons to bits, widening and permuting are
// intrinsics with AVX-512 and plain loops elsewhere, with the same results but for roundings.
#ifndef LOOP_LANES_H
#define LOOP_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#define LANES 16
#define ALL_LANES 0xffffu
#define FAST static inline __attribute__((always_inline))

typedef float lanes __attribute__((vector_size(64)));
typedef float lanes_anywhere __attribute__((vector_size(64), aligned(4), may_alias));
typedef struct lanes3 {
  lanes x, y, z;
} lanes3;

FAST lanes lanes_set(float a) {
  return (lanes){a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a};
}
FAST lanes lanes_load(const float *p) {
  return *(const lanes_anywhere *)p;
}
FAST void lanes_store(float *p, lanes a) {
  *(lanes_anywhere *)p = a;
}
FAST unsigned lowest_bit(uint32_t bits) {
  return (unsigned)__builtin_ctz(bits);
}
FAST uint32_t first_lanes(uint32_t count) {
  return count < LANES ? (1u << count) - 1 : ALL_LANES;
}

#ifdef __AVX512F__
FAST lanes lanes_min(lanes a, lanes b) {
  return (lanes)_mm512_min_ps((__m512)a, (__m512)b);
}
FAST lanes lanes_max(lanes a, lanes b) {
  return (lanes)_mm512_max_ps((__m512)a, (__m512)b);
}
FAST lanes lanes_abs(lanes a) {
  return (lanes)_mm512_abs_ps((__m512)a);
}
FAST lanes lanes_sqrt(lanes a) {
  return (lanes)_mm512_sqrt_ps((__m512)a);
}
// Lanes in which a > b. A NaN is above nothing.
FAST uint32_t lanes_above(lanes a, lanes b) {
  return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GT_OQ);
}
FAST lanes lanes_signed(const int16_t *p) {
  return (lanes)_mm512_cvtepi32_ps(_mm512_cvtepi16_epi32(_mm256_loadu_si256((const __m256i *)p)));
}
FAST lanes lanes_unsigned(const uint16_t *p) {
  return (lanes)_mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(_mm256_loadu_si256((const __m256i *)p)));
}
// Of 32 numbers, those that the five bits from `shift` on of each index say.
FAST lanes lanes_chosen(lanes low, lanes high, const uint16_t *index, int shift) {
  const __m512i all = _mm512_cvtepu16_epi32(_mm256_loadu_si256((const __m256i *)index));
  const __m512i which = _mm512_srli_epi32(all, (unsigned)shift);
  return (lanes)_mm512_permutex2var_ps((__m512)low, which, (__m512)high);
}
// Lane l of the result is lane index[l] of a.
FAST lanes lanes_spread(lanes a, const int32_t *index) {
  return (lanes)_mm512_permutexvar_ps(_mm512_loadu_si512(index), (__m512)a);
}
FAST float lanes_least(lanes a) {
  return _mm512_reduce_min_ps((__m512)a);
}
FAST float lanes_most(lanes a) {
  return _mm512_reduce_max_ps((__m512)a);
}
FAST lanes lanes_pick(uint32_t bits, lanes a, lanes otherwise) {
  return (lanes)_mm512_mask_blend_ps((__mmask16)bits, (__m512)otherwise, (__m512)a);
}
// Near 1 / sqrt(a), to 2^-14; a > 0.
FAST lanes lanes_inverse_root(lanes a) {
  return (lanes)_mm512_rsqrt14_ps((__m512)a);
}
#else
#define EACH_LANE for (int l = 0; l < LANES; l++)
FAST lanes lanes_min(lanes a, lanes b) {
  EACH_LANE a[l] = a[l] < b[l] ? a[l] : b[l];
  return a;
}
FAST lanes lanes_max(lanes a, lanes b) {
  EACH_LANE a[l] = a[l] > b[l] ? a[l] : b[l];
  return a;
}
FAST lanes lanes_abs(lanes a) {
  EACH_LANE a[l] = fabsf(a[l]);
  return a;
}
FAST lanes lanes_sqrt(lanes a) {
  EACH_LANE a[l] = sqrtf(a[l]);
  return a;
}
FAST uint32_t lanes_above(lanes a, lanes b) {
  uint32_t bits = 0;
  EACH_LANE bits |= (uint32_t)(a[l] > b[l]) << l;
  return bits;
}
FAST lanes lanes_signed(const int16_t *p) {
  lanes out;
  EACH_LANE out[l] = (float)p[l];
  return out;
}
FAST lanes lanes_unsigned(const uint16_t *p) {
  lanes out;
  EACH_LANE out[l] = (float)p[l];
  return out;
}
FAST lanes lanes_chosen(lanes low, lanes high, const uint16_t *index, int shift) {
  lanes out;
  EACH_LANE {
    const int i = index[l] >> shift & 31;
    out[l] = i < LANES ? low[i] : high[i - LANES];
  }
  return out;
}
FAST lanes lanes_spread(lanes a, const int32_t *index) {
  lanes out;
  EACH_LANE out[l] = a[index[l]];
  return out;
}
FAST float lanes_least(lanes a) {
  float out = a[0];
  EACH_LANE out = a[l] < out ? a[l] : out;
  return out;
}
FAST float lanes_most(lanes a) {
  float out = a[0];
  EACH_LANE out = a[l] > out ? a[l] : out;
  return out;
}
FAST lanes lanes_pick(uint32_t bits, lanes a, lanes otherwise) {
  EACH_LANE a[l] = bits >> l & 1 ? a[l] : otherwise[l];
  return a;
}
FAST lanes lanes_inverse_root(lanes a) {
  EACH_LANE a[l] = 1 / sqrtf(a[l]);
  return a;
}
#endif

FAST lanes3 lanes3_set(float x, float y, float z) {
  return (lanes3){lanes_set(x), lanes_set(y), lanes_set(z)};
}
FAST lanes3 lanes3_row(const float *row) {
  return lanes3_set(row[0], row[1], row[2]);
}
FAST lanes3 lanes3_sub(lanes3 a, lanes3 b) {
  return (lanes3){a.x - b.x, a.y - b.y, a.z - b.z};
}
FAST lanes3 lanes3_add(lanes3 a, lanes3 b) {
  return (lanes3){a.x + b.x, a.y + b.y, a.z + b.z};
}
FAST lanes3 lanes3_scale(lanes3 a, lanes s) {
  return (lanes3){a.x * s, a.y * s, a.z * s};
}
FAST lanes lanes3_dot(lanes3 a, lanes3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
FAST lanes3 lanes3_cross(lanes3 a, lanes3 b) {
  return (lanes3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
FAST lanes3 lanes3_abs(lanes3 a) {
  return (lanes3){lanes_abs(a.x), lanes_abs(a.y), lanes_abs(a.z)};
}
FAST lanes3 lanes3_min(lanes3 a, lanes3 b) {
  return (lanes3){lanes_min(a.x, b.x), lanes_min(a.y, b.y), lanes_min(a.z, b.z)};
}
FAST lanes3 lanes3_max(lanes3 a, lanes3 b) {
  return (lanes3){lanes_max(a.x, b.x), lanes_max(a.y, b.y), lanes_max(a.z, b.z)};
}
// A matrix (rows) times a in each lane.
FAST lanes3 lanes3_turn(const float *m, lanes3 a) {
  return (lanes3){m[0] * a.x + m[1] * a.y + m[2] * a.z, m[3] * a.x + m[4] * a.y + m[5] * a.z,
                  m[6] * a.x + m[7] * a.y + m[8] * a.z};
}
// Its transpose times a.
FAST lanes3 lanes3_turn_back(const float *m, lanes3 a) {
  return (lanes3){m[0] * a.x + m[3] * a.y + m[6] * a.z, m[1] * a.x + m[4] * a.y + m[7] * a.z,
                  m[2] * a.x + m[5] * a.y + m[8] * a.z};
}
// Not longer than 1, and hardly shorter; 0 where a is next to nothing.
FAST lanes3 lanes3_unit(lanes3 a) {
  const lanes square = lanes3_dot(a, a);
  const lanes inverse = lanes_inverse_root(square) * lanes_set(0.9999f);
  const uint32_t good = lanes_above(square, lanes_set(1e-36f));
  return lanes3_scale(a, lanes_pick(good, inverse, lanes_set(0)));
}

#endif
