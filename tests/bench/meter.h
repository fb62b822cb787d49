// meter.h - a clock, and an allocator that counts, for the benchmarks of large bodies and
// their test.
#ifndef NSVCD_BENCH_METER_H
#define NSVCD_BENCH_METER_H

#include <stdlib.h>

#include "../../examples/scenery/clock.h"

// ---- memory that is counted

typedef struct heap {
  size_t now, most;
} heap;

static void *heap_alloc(size_t size, void *user) {
  heap *h = (heap *)user;
  size_t *memory = (size_t *)malloc(size + 16);
  if (!memory) return NULL;
  memory[0] = size;
  h->now += size;
  h->most = h->now > h->most ? h->now : h->most;
  return memory + 2;
}
static void heap_free(void *memory, void *user) {
  heap *h = (heap *)user;
  if (!memory) return;
  h->now -= ((size_t *)memory)[-2];
  free((size_t *)memory - 2);
}

#endif
