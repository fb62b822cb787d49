// In: the compiler at hand. Out: libc and libm, and how functions are inlined.
#pragma once
#include "../interface/options.h"

#ifdef __TINYC__  // 0.9.27: if a struct and a float, both returned by calls, are passed together
#error "neuralsvcd.h: tcc passes arguments wrongly, and certificates would be false"
#endif
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifndef NSVCD_NO_STDIO
#include <stdio.h>
#endif
// NSVCD_ONE_PATH: nothing may be fused or computed more exactly than it is written.
#ifdef NSVCD_ONE_PATH
#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16)
#error \
    "neuralsvcd.h: NSVCD_ONE_PATH: not with -ffast-math, nor where floats are computed in double"
#endif
// gcc has a flag for that, and a pragma that slows everything down tenfold.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif
#endif
// For functions in which sums and differences of products stand side by side: there gcc 12 fuses
// whatever it is told (vfmaddsub).
#if defined(NSVCD_ONE_PATH) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNFUSED \
  static __attribute__((noinline, unused, optimize("no-tree-slp-vectorize")))
#else
#define NSVCD__UNFUSED static inline
#endif
// For functions that take less stack and flash if they are inlined.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__FORCE_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define NSVCD__FORCE_INLINE static __forceinline
#else
#define NSVCD__FORCE_INLINE static inline
#endif
// For functions whose loops over constant arguments must be unrolled. Left to itself, gcc may not
// inline them, and the decoder takes four times as long (tests/bench/PERFORMANCE.md).
#ifdef __OPTIMIZE_SIZE__
#define NSVCD__INLINE static inline
#else
#define NSVCD__INLINE NSVCD__FORCE_INLINE
#endif
// For functions whose stack would add up in a caller.
#if defined(__GNUC__) || defined(__clang__)
#define NSVCD__NOINLINE __attribute__((noinline))
#elif defined(_MSC_VER)
#define NSVCD__NOINLINE __declspec(noinline)
#else
#define NSVCD__NOINLINE
#endif
#if defined(__GNUC__) && !defined(__clang__)
#define NSVCD__UNROLL _Pragma("GCC unroll 8")  // at -O2 too, so that sums stay in registers
#define NSVCD__O3 __attribute__((optimize("O3")))  // short loops, that -O2 leaves as they are
#else
#define NSVCD__UNROLL
#define NSVCD__O3
#endif
