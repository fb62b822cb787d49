// In: the compiler's flags. Out: how many of 16 lanes a register holds: a *slice*.
//
// Queries work on 16 floats at a time, a slice after the other: a function over 16 lanes loops over
// the slices, and keeps one of them in its variables. Without vectors a slice is one lane, and so
// it is with NSVCD_NO_SIMD. Instruction sets differ in rounding only: fma rounds once or twice.
#pragma once
#include "compiler.h"

#define NSVCD__LANES 16
typedef float nsvcd__row[NSVCD__LANES];  // a number in each lane

#ifndef NSVCD__ISA
// gcc on Windows does not align the stack for what is wider than 16 bytes, and programs crash: its
// bug 54412.
#if defined(_WIN32) && defined(__GNUC__) && !defined(__clang__)
#define NSVCD__NARROW
#endif
#if defined(NSVCD_NO_SIMD)
#define NSVCD__SLICE 1
#elif defined(_MSC_VER) && defined(_M_IX86) && !defined(__clang__)
#define NSVCD__SLICE 1  // cl passes no vectors by value on 32 bits: C2719
#elif defined(__AVX512F__) && !defined(NSVCD__NARROW)
#include <immintrin.h>
#define NSVCD__SLICE 16
#elif defined(__AVX2__) && (defined(__FMA__) || defined(_MSC_VER)) && !defined(NSVCD__NARROW)
#include <immintrin.h>
#define NSVCD__SLICE 8
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#define NSVCD__SLICE 4
#elif defined(__SSE2__) || defined(_M_X64)
#ifdef NSVCD_NO_DISPATCH
#include <emmintrin.h>  // SSE2 alone: compilers take 0.2 s for all of <immintrin.h>
#else
#include <immintrin.h>
#endif
#define NSVCD__SLICE 4
#elif defined(__aarch64__)
#include <arm_neon.h>
#define NSVCD__SLICE 4
#else
#define NSVCD__SLICE 1
#endif
#if NSVCD__SLICE == 16 && defined(__AVX512VNNI__)
#define NSVCD__VNNI  // instructions that multiply bytes
#endif

// The instruction sets that one build may have kernels for: entry/processor.
typedef enum nsvcd__isa { NSVCD__FLAGS, NSVCD__AVX2, NSVCD__AVX512 } nsvcd__isa;
#endif  // NSVCD__ISA
