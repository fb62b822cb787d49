// In: what the compiler was told the processor has. Out: how many of 16 lanes a register holds.
//
// 16 floats side by side, lane by lane, for the sweep and the decoder. One set of operations over
// what the compiler was told the processor has; the plain path says what they mean. They differ in
// rounding only: fma rounds once or twice. NSVCD_NO_SIMD takes the plain path.
#pragma once
#include "compiler.h"

#define NSVCD__LANES 16
// Radius of padding: meets nothing, and its square is still finite. A float to the last digit, for
// it is looked for in blobs, also where constants are computed in double (FLT_EVAL_METHOD).
#define NSVCD__NOWHERE (-999999986991104.0f)
#define NSVCD__HULL NSVCD__LANES  // vertices of a patch's hull, at most
// What the triangle of a entry belongs to: a sheet; a closed surface, by how often it winds; one
// by how many of its triangles a ray crosses, whichever way; or what is nearly a solid. Beside the
// triangle's number, which has the lower bits, they are the upper ones.
enum { NSVCD__SHEET, NSVCD__NEARLY, NSVCD__CLOSED, NSVCD__EITHER_DIRECTION };
#define NSVCD__KIND_SHIFT 30
#define NSVCD__NUMBER 0x3fffffffu

// The tests hold what a query does against the bound that nsvcd_sweep states.
#ifndef NSVCD__TALLY
#define NSVCD__TALLY(what, amount) ((void)0)
#endif

// What is done 16 lanes wide is done a *slice* at a time: as many lanes as a register holds. A
// function over 16 lanes goes through its slices in a loop, and keeps no more than one of them in
// its variables; on a machine without vectors a slice is one lane.

#ifndef NSVCD__ISA
// gcc on Windows puts what is wider than 16 bytes where the stack is not aligned for it, and the
// program ends there: its bug 54412.
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
#include <immintrin.h>
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
#endif  // NSVCD__ISA
