// failing_heap.h - an allocator that counts, and that fails one allocation on purpose.
#ifndef FAILING_HEAP_H
#define FAILING_HEAP_H

#include <stdlib.h>

typedef struct failing_heap {
  int live, calls;
  int fail_at;  // the number of the allocation that fails, from 0; -1: none
} failing_heap;
static void *failing_heap_alloc(size_t size, void *user) {
  failing_heap *heap = (failing_heap *)user;
  if (heap->calls++ == heap->fail_at) return NULL;
  heap->live++;
  return malloc(size);
}
static void failing_heap_free(void *memory, void *user) {
  ((failing_heap *)user)->live--;
  free(memory);
}

#endif
