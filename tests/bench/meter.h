// meter.h - a clock, numbers in order, and an allocator that counts, for benchmarks and tests of what
// things cost.
#ifndef NSVCD_BENCH_METER_H
#define NSVCD_BENCH_METER_H

#include <stdlib.h>

#include "../../examples/scenery/clock.h"

// ---- numbers in order, for medians and other quantiles

static int meter_compare(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}
static void meter_sort(double *numbers, size_t count) {
  qsort(numbers, count, sizeof *numbers, meter_compare);
}

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
