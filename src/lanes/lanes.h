// In, out: slices of 16 lanes: as many floats as a register holds. v is a slice, v3 a vector of
// three of them.
#pragma once
#include "../ground/spheres.h"
#include "../ground/slices.h"

// ---- operations, for each instruction set; the plain C ones say what they mean. Macros, so that
// the sets of x86 share one text, which entry/processor compiles three times.

#undef NSVCD__OP
#undef NSVCD__OF_ALL
#undef NSVCD__FMA
#undef NSVCD__LE
#undef NSVCD__LT
#undef NSVCD__BITS
#undef NSVCD__SELECT

#if NSVCD__SLICE == 1
typedef float nsvcd__v;
#define nsvcd__v_load(p) (*(p))
#define nsvcd__v_store(p, a) (*(p) = (a))
#define nsvcd__v_set(x) ((float)(x))
#define nsvcd__v_add(a, b) ((float)((a) + (b)))
#define nsvcd__v_sub(a, b) ((float)((a) - (b)))
#define nsvcd__v_mul(a, b) ((float)((a) * (b)))
#define nsvcd__v_div(a, b) ((float)((a) / (b)))
#define NSVCD__MIN(a, b) (a < b ? a : b)
#define NSVCD__MAX(a, b) (a > b ? a : b)
#define nsvcd__v_sqrt sqrtf
#define NSVCD__LE(a, b) ((a) <= (b))
#define NSVCD__LT(a, b) ((a) < (b))
#define NSVCD__BITS(mask) (mask)
#define NSVCD__SELECT(mask, x, y) (mask ? x : y)
#else
#define nsvcd__v_add NSVCD__OP(add)
#define nsvcd__v_sub NSVCD__OP(sub)
#define nsvcd__v_mul NSVCD__OP(mul)
#define nsvcd__v_div NSVCD__OP(div)
#endif

#if defined(__wasm_simd128__) && NSVCD__SLICE == 4
typedef v128_t nsvcd__v;
#define NSVCD__OP(name) wasm_f32x4_##name
#define nsvcd__v_load wasm_v128_load
#define nsvcd__v_store wasm_v128_store
#define nsvcd__v_set NSVCD__OP(splat)
// pmin(b, a) is a < b ? a : b, one instruction of x86; min, which handles NaN and -0, takes many.
#define NSVCD__MIN(a, b) NSVCD__OP(pmin)(b, a)
#define NSVCD__MAX(a, b) NSVCD__OP(pmax)(b, a)
#define nsvcd__v_sqrt NSVCD__OP(sqrt)
#define NSVCD__LE(a, b) NSVCD__OP(le)(a, b)
#define NSVCD__LT(a, b) NSVCD__OP(lt)(a, b)
#define NSVCD__BITS(mask) wasm_i32x4_bitmask(mask)
#define NSVCD__SELECT(mask, x, y) wasm_v128_bitselect(x, y, mask)

#elif defined(__aarch64__) && NSVCD__SLICE == 4
typedef float32x4_t nsvcd__v;
#define NSVCD__OP(name) v##name##q_f32
#define nsvcd__v_load vld1q_f32
#define nsvcd__v_store vst1q_f32
#define nsvcd__v_set vdupq_n_f32
#define NSVCD__FMA(a, b, c) vfmaq_f32(c, a, b)
#define NSVCD__MIN(a, b) NSVCD__OP(min)(a, b)
#define NSVCD__MAX(a, b) NSVCD__OP(max)(a, b)
#define nsvcd__v_sqrt NSVCD__OP(sqrt)
#define NSVCD__LE(a, b) NSVCD__OP(cle)(a, b)
#define NSVCD__LT(a, b) NSVCD__OP(clt)(a, b)
#define NSVCD__BITS(mask) nsvcd__v_bits(mask)
#define NSVCD__SELECT(mask, x, y) NSVCD__OP(bsl)(mask, x, y)
static inline uint32_t nsvcd__v_bits(uint32x4_t lanes) {
  static const uint32_t bit[4] = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(lanes, vld1q_u32(bit)));
}

#elif NSVCD__SLICE > 1  // x86
#define nsvcd__v_load NSVCD__OP(loadu)
#define nsvcd__v_store NSVCD__OP(storeu)
#define nsvcd__v_set NSVCD__OP(set1)
#define NSVCD__MIN(a, b) NSVCD__OF_ALL(min, a, b)
#define NSVCD__MAX(a, b) NSVCD__OF_ALL(max, a, b)
#define nsvcd__v_sqrt(a) NSVCD__OF_ALL(sqrt, a)
#endif

#if NSVCD__SLICE == 16
typedef __m512 nsvcd__v;
#define NSVCD__OP(name) _mm512_##name##_ps
// With a mask of all lanes: unmasked, gcc's own header warns in C++.
#define NSVCD__ALL ((__mmask16)0xffff)
#define NSVCD__OF_ALL(name, ...) _mm512_maskz_##name##_ps(NSVCD__ALL, __VA_ARGS__)
#define NSVCD__FMA(a, b, c) _mm512_fmadd_ps(a, b, c)
#define NSVCD__LE(a, b) _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ)
#define NSVCD__LT(a, b) _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ)
#define NSVCD__BITS(mask) mask
#define NSVCD__SELECT(mask, x, y) _mm512_mask_blend_ps(mask, y, x)
#elif NSVCD__SLICE == 8
typedef __m256 nsvcd__v;
#define NSVCD__OP(name) _mm256_##name##_ps
#define NSVCD__OF_ALL(name, ...) _mm256_##name##_ps(__VA_ARGS__)
#define NSVCD__FMA(a, b, c) _mm256_fmadd_ps(a, b, c)
#define NSVCD__LE(a, b) _mm256_cmp_ps(a, b, _CMP_LE_OQ)
#define NSVCD__LT(a, b) _mm256_cmp_ps(a, b, _CMP_LT_OQ)
#define NSVCD__BITS(mask) _mm256_movemask_ps(mask)
#define NSVCD__SELECT(mask, x, y) _mm256_blendv_ps(y, x, mask)
#elif NSVCD__SLICE == 4 && !defined(NSVCD__OP)
typedef __m128 nsvcd__v;
#define NSVCD__OP(name) _mm_##name##_ps
#define NSVCD__OF_ALL(name, ...) _mm_##name##_ps(__VA_ARGS__)
#define NSVCD__LE(a, b) _mm_cmple_ps(a, b)
#define NSVCD__LT(a, b) _mm_cmplt_ps(a, b)
#define NSVCD__BITS(mask) _mm_movemask_ps(mask)
#define NSVCD__SELECT(mask, x, y) _mm_or_ps(_mm_and_ps(mask, x), _mm_andnot_ps(mask, y))
#endif

#ifdef NSVCD_ONE_PATH
#undef NSVCD__FMA
#endif
#ifndef NSVCD__FMA
#define NSVCD__FMA(a, b, c) nsvcd__v_add(nsvcd__v_mul(a, b), c)
#endif
#define nsvcd__v_fma(a, b, c) NSVCD__FMA(a, b, c)  // a b + c
// Bit i is set if a <= b in lane i of the slice, or a < b.
#define nsvcd__v_le(a, b) ((uint32_t)NSVCD__BITS(NSVCD__LE(a, b)))
#define nsvcd__v_lt(a, b) ((uint32_t)NSVCD__BITS(NSVCD__LT(a, b)))
static inline nsvcd__v nsvcd__v_min(nsvcd__v a, nsvcd__v b) {
  return NSVCD__MIN(a, b);
}
static inline nsvcd__v nsvcd__v_max(nsvcd__v a, nsvcd__v b) {
  return NSVCD__MAX(a, b);
}
// a <= b ? x : y.
static inline nsvcd__v nsvcd__v_pick(nsvcd__v a, nsvcd__v b, nsvcd__v x, nsvcd__v y) {
  return NSVCD__SELECT(NSVCD__LE(a, b), x, y);
}
// The least of all lanes.
static inline float nsvcd__v_least(nsvcd__v a) {
#if NSVCD__SLICE == 1
  return a;
#elif defined(__aarch64__)
  return vminvq_f32(a);
#elif defined(__wasm_simd128__)
  const nsvcd__v two = nsvcd__v_min(a, wasm_i32x4_shuffle(a, a, 2, 3, 0, 1));
  return wasm_f32x4_extract_lane(nsvcd__v_min(two, wasm_i32x4_shuffle(two, two, 1, 0, 3, 2)),
                                 0);
#else
#if NSVCD__SLICE == 4
  const __m128 four = a;
#else
#if NSVCD__SLICE == 8
  const __m256 eight = a;
#else
  const __m512d whole = _mm512_castps_pd(a);
  const __m256d low = _mm512_maskz_extractf64x4_pd(0xf, whole, 0);
  const __m256d high = _mm512_maskz_extractf64x4_pd(0xf, whole, 1);
  const __m256 eight = _mm256_min_ps(_mm256_castpd_ps(low), _mm256_castpd_ps(high));
#endif
  const __m128 four =
      _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
#endif
  const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
#endif
}
static inline nsvcd__v nsvcd__v_load_int16(const int16_t *p) {
#if NSVCD__SLICE == 1
  return (float)*p;
#elif defined(__aarch64__)
  return vcvtq_f32_s32(vmovl_s16(vld1_s16(p)));
#elif defined(__wasm_simd128__)
  return wasm_f32x4_convert_i32x4(wasm_i32x4_load16x4(p));
#elif NSVCD__SLICE == 4
  const __m128i packed = _mm_loadl_epi64((const __m128i *)(const void *)p);
  return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(packed, packed), 16));
#elif NSVCD__SLICE == 8
  const __m128i packed = _mm_loadu_si128((const __m128i *)(const void *)p);
  return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(packed));
#else
  const __m256i packed = _mm256_loadu_si256((const __m256i *)(const void *)p);
  const __m512i wide = _mm512_maskz_cvtepi16_epi32(NSVCD__ALL, packed);
  return _mm512_maskz_cvtepi32_ps(NSVCD__ALL, wide);
#endif
}
static inline nsvcd__v nsvcd__v_load_int8(const int8_t *p) {
#if NSVCD__SLICE == 1
  return (float)*p;
#elif defined(__wasm_simd128__)
  const v128_t wide = wasm_i16x8_extend_low_i8x16(wasm_v128_load32_zero(p));
  return wasm_f32x4_convert_i32x4(wasm_i32x4_extend_low_i16x8(wide));
#elif NSVCD__SLICE == 4
  int32_t word;
  memcpy(&word, p, sizeof word);
#if defined(__aarch64__)
  const int16x8_t wide = vmovl_s8(vcreate_s8((uint64_t)(uint32_t)word));
  return vcvtq_f32_s32(vmovl_s16(vget_low_s16(wide)));
#else
  const __m128i packed = _mm_cvtsi32_si128(word);
  const __m128i pairs = _mm_unpacklo_epi8(packed, packed);
  return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(pairs, pairs), 24));
#endif
#elif NSVCD__SLICE == 8
  const __m128i packed = _mm_loadl_epi64((const __m128i *)(const void *)p);
  return _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(packed));
#else
  const __m128i packed = _mm_loadu_si128((const __m128i *)(const void *)p);
  const __m512i wide = _mm512_maskz_cvtepi8_epi32(NSVCD__ALL, packed);
  return _mm512_maskz_cvtepi32_ps(NSVCD__ALL, wide);
#endif
}

#define NSVCD__SLICE_MASK (((uint32_t)1 << (NSVCD__SLICE - 1) << 1) - 1)
#define NSVCD__EACH_SLICE(l) for (size_t l = 0; l < NSVCD__LANES; l += NSVCD__SLICE)

static inline nsvcd__v nsvcd__v_clamp(nsvcd__v a, float low, float high) {
  return nsvcd__v_min(nsvcd__v_max(a, nsvcd__v_set(low)), nsvcd__v_set(high));
}
// All lanes times a number, and plus a number.
static inline nsvcd__v nsvcd__v_scale(nsvcd__v a, float s) {
  return nsvcd__v_mul(a, nsvcd__v_set(s));
}
static inline nsvcd__v nsvcd__v_plus(nsvcd__v a, float s) {
  return nsvcd__v_add(a, nsvcd__v_set(s));
}
static inline nsvcd__v nsvcd__v_negate(nsvcd__v a) {
  return nsvcd__v_sub(nsvcd__v_set(0), a);
}

static inline nsvcd__v nsvcd__v_abs(nsvcd__v a) {
  return nsvcd__v_max(a, nsvcd__v_negate(a));
}

// A slice of vectors.
typedef struct nsvcd__v3 {
  nsvcd__v x, y, z;
} nsvcd__v3;

NSVCD__INLINE nsvcd__v3 nsvcd__v3_of(nsvcd__v x, nsvcd__v y, nsvcd__v z) {
  const nsvcd__v3 out = {x, y, z};
  return out;
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_set(nsvcd__f3 a) {
  return nsvcd__v3_of(nsvcd__v_set(a.x), nsvcd__v_set(a.y), nsvcd__v_set(a.z));
}
#define NSVCD__BY_AXIS(op, a, b) nsvcd__v3_of(op(a.x, b.x), op(a.y, b.y), op(a.z, b.z))
NSVCD__INLINE nsvcd__v3 nsvcd__v3_add(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_add, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_sub(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_sub, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_negate(nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v_negate(a.x), nsvcd__v_negate(a.y), nsvcd__v_negate(a.z));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_min(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_min, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_max(nsvcd__v3 a, nsvcd__v3 b) {
  return NSVCD__BY_AXIS(nsvcd__v_max, a, b);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_scale(nsvcd__v3 a, nsvcd__v s) {
  return nsvcd__v3_of(nsvcd__v_mul(s, a.x), nsvcd__v_mul(s, a.y), nsvcd__v_mul(s, a.z));
}
// a + s b.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_fma(nsvcd__v s, nsvcd__v3 b, nsvcd__v3 a) {
  return nsvcd__v3_of(nsvcd__v_fma(s, b.x, a.x), nsvcd__v_fma(s, b.y, a.y),
                      nsvcd__v_fma(s, b.z, a.z));
}
NSVCD__INLINE nsvcd__v nsvcd__v3_dot(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v_fma(a.x, b.x, nsvcd__v_fma(a.y, b.y, nsvcd__v_mul(a.z, b.z)));
}
// s + a b.
NSVCD__INLINE nsvcd__v nsvcd__v3_dot_add(nsvcd__v3 a, nsvcd__v3 b, nsvcd__v s) {
  const nsvcd__v sum = nsvcd__v_fma(a.x, b.x, s);
  return nsvcd__v_fma(a.z, b.z, nsvcd__v_fma(a.y, b.y, sum));
}
NSVCD__INLINE nsvcd__v nsvcd__v3_norm(nsvcd__v3 a) {
  return nsvcd__v_sqrt(nsvcd__v3_dot(a, a));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_cross(nsvcd__v3 a, nsvcd__v3 b) {
  return nsvcd__v3_of(nsvcd__v_sub(nsvcd__v_mul(a.y, b.z), nsvcd__v_mul(a.z, b.y)),
                      nsvcd__v_sub(nsvcd__v_mul(a.z, b.x), nsvcd__v_mul(a.x, b.z)),
                      nsvcd__v_sub(nsvcd__v_mul(a.x, b.y), nsvcd__v_mul(a.y, b.x)));
}
// The centres of a slice of spheres.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_centres(nsvcd__spheres all, size_t l) {
  return nsvcd__v3_of(nsvcd__v_load(all.x + l), nsvcd__v_load(all.y + l),
                      nsvcd__v_load(all.z + l));
}
// From rows of x, y and z, `stride` apart.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_get(const float *p, size_t stride) {
  return nsvcd__v3_of(nsvcd__v_load(p), nsvcd__v_load(p + stride),
                      nsvcd__v_load(p + 2 * stride));
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_load_int8(const int8_t *p, size_t stride) {
  return nsvcd__v3_of(nsvcd__v_load_int8(p), nsvcd__v_load_int8(p + stride),
                      nsvcd__v_load_int8(p + 2 * stride));
}
NSVCD__INLINE void nsvcd__v3_put(nsvcd__v3 a, float *p, size_t stride) {
  nsvcd__v_store(p, a.x);
  nsvcd__v_store(p + stride, a.y);
  nsvcd__v_store(p + 2 * stride, a.z);
}
// From three rows of 16 numbers.
NSVCD__INLINE nsvcd__v3 nsvcd__v3_rows(const float *p) {
  return nsvcd__v3_get(p, NSVCD__LANES);
}
// Lanes l .. l + SLICE - 1 of p (3, LANES).
NSVCD__INLINE void nsvcd__v3_store(nsvcd__row *p, size_t l, nsvcd__v3 a) {
  nsvcd__v3_put(a, p[0] + l, NSVCD__LANES);
}
NSVCD__INLINE nsvcd__v3 nsvcd__v3_load(nsvcd__row *p, size_t l) {
  return nsvcd__v3_get(p[0] + l, NSVCD__LANES);
}

// Unit vectors; the x axis where the length is 0.
static inline nsvcd__v3 nsvcd__v3_unit(nsvcd__v3 a) {
  const nsvcd__v3 x = nsvcd__v3_set(nsvcd__f3_of(1, 0, 0));
  const nsvcd__v least = nsvcd__v_set(1e-18f);
  const nsvcd__v length = nsvcd__v3_norm(a);
  const nsvcd__v inverse = nsvcd__v_div(x.x, nsvcd__v_max(length, least));
  const nsvcd__v3 unit = nsvcd__v3_scale(a, inverse);
  return nsvcd__v3_of(nsvcd__v_pick(length, least, x.x, unit.x),
                      nsvcd__v_pick(length, least, x.y, unit.y),
                      nsvcd__v_pick(length, least, x.z, unit.z));
}

// Ranges along a direction.
typedef struct nsvcd__v_range {
  nsvcd__v low, high;
} nsvcd__v_range;

// The square of a sum of radii, with its sign: a negative sum, of padding, meets nothing.
static inline nsvcd__v nsvcd__v_signed_square(nsvcd__v sum) {
  return nsvcd__v_mul(sum, nsvcd__v_abs(sum));
}

// A ray in a body's frame, with a radius.
typedef struct nsvcd__beam {
  nsvcd__f3 from, along;  // along: a unit vector
  float width;
} nsvcd__beam;

// A filter of a traversal: spheres that a beam meets.
static uint32_t nsvcd__is_on_beam(const void *what, nsvcd__spheres all) {
  const nsvcd__beam *beam = (const nsvcd__beam *)what;
  const nsvcd__v3 n = nsvcd__v3_set(beam->along);
  const nsvcd__v3 from = nsvcd__v3_set(beam->from);
  uint32_t met = 0;
  NSVCD__EACH_SLICE(l) {
    const nsvcd__v3 d = nsvcd__v3_sub(nsvcd__v3_centres(all, l), from);
    const nsvcd__v3 off = nsvcd__v3_cross(d, n);
    const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(all.r + l), beam->width);
    const nsvcd__v square = nsvcd__v3_dot(off, off);
    const uint32_t ahead = nsvcd__v_le(nsvcd__v_negate(sum), nsvcd__v3_dot(d, n));
    met |= (ahead & nsvcd__v_le(square, nsvcd__v_signed_square(sum))) << l;
  }
  return met;
}
