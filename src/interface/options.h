// In: the switches that a program defines. Out: the version, switches that follow, NSVCDDEF.
#pragma once

// the version, as in the first line; before 1.0 a minor version may change what a program sees
#define NSVCD_VERSION "0.3.0"
#define NSVCD_VERSION_MAJOR 0
#define NSVCD_VERSION_MINOR 3
#define NSVCD_VERSION_PATCH 0

#if defined(NSVCD_NO_ENCODER) && !defined(NSVCD_NO_READERS)
#define NSVCD_NO_READERS
#endif
#if defined(NSVCD_NO_PROOF) && defined(NSVCD_NO_NETWORK)
#error "neuralsvcd.h: NSVCD_NO_PROOF and NSVCD_NO_NETWORK leave nothing that answers"
#endif
#if defined(NSVCD_NO_NETWORK) && !defined(NSVCD_NO_GRADIENT)
#define NSVCD_NO_GRADIENT
#endif
#if defined(NSVCD_NO_GRADIENT) && !defined(NSVCD_NO_OPTIMIZER)
#define NSVCD_NO_OPTIMIZER
#endif
#if defined(NSVCD_NO_INT8) && defined(NSVCD_NO_FLOAT)
#error "neuralsvcd.h: NSVCD_NO_INT8 and NSVCD_NO_FLOAT leave no decoder"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ && \
    defined(NEURALSVCD_IMPLEMENTATION) && defined(__GNUC__)
#pragma GCC warning \
    "neuralsvcd.h: -ffinite-math-only: bad input is still refused, but results are untested"
#endif

#include <stddef.h>
#include <stdint.h>

#if defined(NSVCD_STATIC) && (defined(__GNUC__) || defined(__clang__))
#define NSVCDDEF static __attribute__((unused))  // few programs call all of them
#elif defined(NSVCD_STATIC)
#define NSVCDDEF static
#else
#define NSVCDDEF extern
#endif
