// In: a processor. Out: the kernels for the widest vectors that it has.
//
// THE WAIST. A *kernel* is a function that works on vectors and is called from above. There are
// seven: self_test_lanes, look_all, separate, is_contained_at_start, bound_distance, ask_network
// and record. NSVCD__KERNEL(isa, separate)(...) calls one of them.
//
// If the compiler's flags allow SSE2 only, the default on x86-64, the rooms that use vectors are
// compiled three times: with SSE2 above, and here with AVX2 and with AVX-512, under other private
// names: nsvcd__separate becomes nsvcd__separate_avx2. For that the header includes itself. At each
// call the processor decides which of them answers. NSVCD_NO_DISPATCH leaves SSE2 only.
#pragma once
#include "../look/look.h"
#include "../network/tape.h"
#include "../segments/self_test.h"
#include "../separate/distance_bound.h"
#include "../separate/loop.h"

#if NSVCD__SLICE == 4 && !defined(NSVCD_NO_DISPATCH) && !defined(NSVCD__NARROW) && \
    !defined(NSVCD__FROM_ROOMS)
#if defined(__clang__) && defined(_MSC_VER)
// clang-cl's <immintrin.h> has only what the flags allow: /arch:AVX2
#elif defined(__x86_64__) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 8))
#define NSVCD__DISPATCH
#elif defined(_M_X64) && !defined(_M_ARM64EC)
#include <intrin.h>
#define NSVCD__DISPATCH
#endif
#endif

#ifdef NSVCD__DISPATCH
#define NSVCD__JOIN(name, isa) name##isa
#define NSVCD__OF_ISA(name, isa) NSVCD__JOIN(name, isa)
#define NSVCD__AT(name) NSVCD__OF_ISA(nsvcd__##name, NSVCD__ISA)
#define NSVCD__NUMBER_AT(name) NSVCD__OF_ISA(NSVCD__##name, NSVCD__ISA)

// ---- the names, as src/make_header.py writes them

// ---- the passes

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2,fma,bmi,bmi2,lzcnt,popcnt")
#elif defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi,bmi2,lzcnt,popcnt"))), \
                             apply_to = function)
#endif
#undef NSVCD__SLICE
#define NSVCD__SLICE 8
#define NSVCD__ISA _avx2
#include "neuralsvcd.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC target("avx512f,avx512vl,avx512vnni")
#elif defined(__clang__)
#pragma clang attribute pop
#pragma clang attribute push( \
    __attribute__((target("avx512f,avx512vl,avx512vnni,fma,bmi,bmi2,lzcnt,popcnt"))), \
    apply_to = function)
#endif
#undef NSVCD__SLICE
#undef NSVCD__ISA
#undef NSVCD__BYTE_ROWS
#undef NSVCD__VNNI
#define NSVCD__SLICE 16
#define NSVCD__ISA _avx512
#define NSVCD__VNNI
#include "neuralsvcd.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC pop_options
#elif defined(__clang__)
#pragma clang attribute pop
#endif

// from here on names and vectors are those above again
#undef NSVCD__SLICE
#undef NSVCD__ISA
#undef NSVCD__VNNI
#define NSVCD__SLICE 4
#undef NSVCD__AT
#undef NSVCD__NUMBER_AT
#define NSVCD__AT(name) nsvcd__##name
#define NSVCD__NUMBER_AT(name) NSVCD__##name

#if defined(_MSC_VER) && !defined(__clang__)
// What the processor and the system have. Remembered in one word, to which all threads write the
// same.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  static volatile long known = -1;
  int first[4];
  int seventh[4];
  if (known >= 0) return (nsvcd__isa)known;
  __cpuid(first, 0);
  if (first[0] < 7) return NSVCD__FLAGS;
  __cpuid(first, 1);
  __cpuidex(seventh, 7, 0);
  // OSXSAVE: the system saves vector registers
  const int keeps_registers = first[2] >> 27 & 1;
  const unsigned long long kept = keeps_registers ? _xgetbv(0) : 0;
  const int fma = first[2] >> 12 & 1;
  const unsigned has = (unsigned)seventh[1];
  const unsigned bmi = has >> 3 & has >> 8 & 1;
  const int avx2 = (kept & 6) == 6 && fma && bmi && has >> 5 & 1;
  const unsigned vnni = has >> 16 & has >> 31 & (unsigned)seventh[2] >> 11 & 1;
  known = !avx2 ? NSVCD__FLAGS : (kept & 0xe0) == 0xe0 && vnni ? NSVCD__AVX512 : NSVCD__AVX2;
  return (nsvcd__isa)known;
}
#else
// What the processor and the system have. The compiler's runtime asks them before main.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  const int fma = __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (!fma || !__builtin_cpu_supports("avx2")) return NSVCD__FLAGS;
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni"))
    return NSVCD__AVX512;
  return NSVCD__AVX2;
}
#endif

#define NSVCD__KERNEL(isa, name) \
  ((isa) == NSVCD__AVX512 ? nsvcd__##name##_avx512 \
   : (isa) == NSVCD__AVX2 ? nsvcd__##name##_avx2 \
                          : nsvcd__##name)
#else
static nsvcd__isa nsvcd__isa_at_hand(void) {
  return NSVCD__FLAGS;
}
#define NSVCD__KERNEL(isa, name) ((void)(isa), nsvcd__##name)
#endif  // NSVCD__DISPATCH

// By the kernels of one instruction set. The triangles are apart when one of them is raised.
static nsvcd_result nsvcd__run_self_test(nsvcd__isa isa) {
  int right = NSVCD__KERNEL(isa, self_test_lanes)();
#ifndef NSVCD_NO_PROOF
  const volatile double height = 2.8;  // volatile, or the compiler would compute all this
  const nsvcd__d3 a[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  nsvcd__d3 b[3] = {{0.25, 0.25, -1}, {0.25, 0.25, 1}, {2, 2, 1}};
  right &= !(nsvcd__nearest_of(a, b).square > 0);
  for (size_t k = 0; k < 3; k++) b[k].z += 1 + height;
  right &= fabs(nsvcd__nearest_of(a, b).square - height * height) < 1e-9;
#endif
  return right ? NSVCD_OK : NSVCD_ERROR_BUILD;
}

NSVCDDEF nsvcd_result nsvcd_self_test(void) {
  return nsvcd__run_self_test(nsvcd__isa_at_hand());
}
