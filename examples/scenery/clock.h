// clock.h - seconds of a clock that only goes on. Define _POSIX_C_SOURCE 200112L before anything.
#ifndef NSVCD_SCENERY_CLOCK_H
#define NSVCD_SCENERY_CLOCK_H

#include <time.h>

static inline double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
