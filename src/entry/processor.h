// In: a question. Out: its answer, by the functions for the widest vectors that the processor has.
//
// If the compiler's flags allow SSE2 only, the default on x86-64, all that a query does is compiled
// three times: with SSE2 above, and here with AVX2 and with AVX-512. At each call the processor
// decides which of them answers. NSVCD_NO_DISPATCH leaves SSE2 only.
//
// For that the header includes itself. Only the rooms that use vectors are compiled again, under
// other private names: nsvcd__prove becomes nsvcd__prove_avx2.
#pragma once
#include "../query/self_test.h"
#include "../gradient/gradient.h"

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

// gcc makes these loops fast only at -O3: they take 0.75 to 0.85 of the time at -O2. Its clones of
// functions by constant arguments gain nothing, at 30 KB and an eighth of its own time.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
#pragma GCC optimize("O3", "no-ipa-cp-clone")
#endif
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

typedef enum nsvcd__isa { NSVCD__SSE2, NSVCD__AVX2, NSVCD__AVX512 } nsvcd__isa;

#if defined(_MSC_VER) && !defined(__clang__)
// What the processor and the system have. Remembered in one word, to which all threads write the
// same.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  static volatile long known = -1;
  int first[4];
  int seventh[4];
  if (known >= 0) return (nsvcd__isa)known;
  __cpuid(first, 0);
  if (first[0] < 7) return NSVCD__SSE2;
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
  known = !avx2 ? NSVCD__SSE2 : (kept & 0xe0) == 0xe0 && vnni ? NSVCD__AVX512 : NSVCD__AVX2;
  return (nsvcd__isa)known;
}
#else
// What the processor and the system have. The compiler's runtime asks them before main.
static nsvcd__isa nsvcd__isa_at_hand(void) {
  const int fma = __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (!fma || !__builtin_cpu_supports("avx2")) return NSVCD__SSE2;
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni"))
    return NSVCD__AVX512;
  return NSVCD__AVX2;
}
#endif

#define NSVCD__BEST(name) \
  (nsvcd__isa_at_hand() == NSVCD__AVX512 ? nsvcd__##name##_avx512 \
   : nsvcd__isa_at_hand() == NSVCD__AVX2 ? nsvcd__##name##_avx2 \
                                         : nsvcd__##name)
#else
#define NSVCD__BEST(name) nsvcd__##name
#endif  // NSVCD__DISPATCH

// ---- the public functions of queries

NSVCDDEF nsvcd_result nsvcd_self_test(void) {
  return NSVCD__BEST(run_self_test)();
}

NSVCDDEF size_t nsvcd_sweep_workspace_size(const nsvcd_question *question) {
  return NSVCD__BEST(sweep_size)(question);
}

NSVCDDEF nsvcd_result nsvcd_sweep(const nsvcd_question *question, void *workspace,
                                  size_t workspace_size, nsvcd_answer *answer) {
  return NSVCD__BEST(run_batch)(question, 1, workspace, workspace_size, answer);
}

NSVCDDEF nsvcd_result nsvcd_sweep_batch(const nsvcd_question *questions, size_t count,
                                        void *workspace, size_t workspace_size,
                                        nsvcd_answer *answers) {
  return NSVCD__BEST(run_batch)(questions, count, workspace, workspace_size, answers);
}

#ifndef NSVCD_NO_GRADIENT
NSVCDDEF nsvcd_result nsvcd_sweep_gradient(const nsvcd_question *question, void *workspace,
                                           size_t workspace_size, nsvcd_answer *answer,
                                           float *gradient_a, float *gradient_b) {
  return NSVCD__BEST(run_gradient)(question, workspace, workspace_size, answer, gradient_a,
                                   gradient_b);
}
#endif
