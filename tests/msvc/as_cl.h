// Before neuralsvcd.h, clang is made to look like Microsoft's cl to it: all intrinsics are declared, whatever the flags, and
// of what a compiler says of itself, what cl does not say is taken back. tests/msvc.sh gives the flags.
#if defined(_M_X64) || defined(_M_IX86)
#include <intrin.h>
#endif
#undef __clang__
#undef __x86_64__
#undef __i386__
#undef __aarch64__
#undef __OPTIMIZE__
#undef __OPTIMIZE_SIZE__
#undef __FAST_MATH__
#undef __FINITE_MATH_ONLY__
#undef __SSE2__
#undef __AVX__
#undef __FMA__
#undef __AVX512VL__
#undef __AVX512VNNI__
#undef __AVX2__
#undef __AVX512F__
#if defined(ARCH_AVX2) || defined(ARCH_AVX512)  // cl /arch:AVX2, /arch:AVX512
#define __AVX__ 1
#define __AVX2__ 1
#endif
#ifdef ARCH_AVX512
#define __AVX512F__ 1
#define __AVX512VL__ 1
#endif
