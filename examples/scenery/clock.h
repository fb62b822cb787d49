// clock.h - seconds of a clock that only goes on. Define _POSIX_C_SOURCE 200112L before anything.
// What C99 lacks is here, for POSIX and for Windows: the examples call nothing else beside C99.
#ifndef NSVCD_SCENERY_CLOCK_H
#define NSVCD_SCENERY_CLOCK_H

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
#undef near  // words of 16-bit Windows
#undef far
#else
#include <time.h>
#endif

static inline double seconds(void) {
#if defined(_WIN32)
  LARGE_INTEGER now, frequency;
  QueryPerformanceCounter(&now);
  QueryPerformanceFrequency(&frequency);
  return (double)now.QuadPart / (double)frequency.QuadPart;
#else
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
#endif
}

#endif
