// Arrays from an allocator, and rows of a workspace: sizes that cannot be counted, and alignment.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "check.h"

void test_memory(void);

// What an allocator was asked for last, and how often it was given something back.
typedef struct memory_log {
  size_t size;
  int calls, freed;
} memory_log;

static void *memory_alloc(size_t size, void *user) {
  memory_log *log = (memory_log *)user;
  log->size = size;
  log->calls++;
  return log;
}
static void memory_free(void *memory, void *user) {
  memory_log *log = (memory_log *)user;
  CHECK(memory == log);
  log->freed++;
}

// The allocator sees the product, or nothing where a size cannot hold it.
static void memory_arrays_are_counted(void) {
  memory_log log = {0, 0, 0};
  const nsvcd_allocator allocator = {memory_alloc, memory_free, &log};
  const size_t sizes[4] = {1, 3, 8, 24};
  int calls = 0;
  for (size_t n = 0; n < 4; n++) {
    const size_t most = SIZE_MAX / sizes[n];
    CHECK(nsvcd__alloc_array(&allocator, most, sizes[n]) == &log);
    CHECK(log.size == most * sizes[n]);
    CHECK_EQ(log.calls, ++calls);
    if (most == SIZE_MAX)
      continue;
    CHECK(nsvcd__alloc_array(&allocator, most + 1, sizes[n]) == NULL);
    CHECK(nsvcd__alloc_array(&allocator, SIZE_MAX, sizes[n]) == NULL);
    CHECK_EQ(log.calls, calls);
  }
  (void)nsvcd__alloc_d3s(&allocator, 7);
  CHECK_EQ(log.size, 7 * 24);
  (void)nsvcd__alloc_f3s(&allocator, 7);
  CHECK_EQ(log.size, 7 * 12);
  (void)nsvcd__alloc_sizes(&allocator, 7);
  CHECK_EQ(log.size, 7 * sizeof(size_t));
  (void)nsvcd__alloc_words(&allocator, 7);
  CHECK_EQ(log.size, 28);
  (void)nsvcd__alloc_floats(&allocator, 7);
  CHECK_EQ(log.size, 28);
  nsvcd__free(&allocator, &log);
  nsvcd__free(&allocator, NULL);  // of which a caller's function need not know
  CHECK_EQ(log.freed, 1);
  CHECK(nsvcd__alloc_array(NULL, SIZE_MAX, 2) == NULL);
  nsvcd__free(NULL, nsvcd__alloc_array(NULL, 3, 8));
}

// Rows follow each other, aligned; counting takes the same steps as laying out, and goes on where a
// size of 32 bits ends.
static void memory_rows_follow_each_other(void) {
  const size_t rows[5] = {3, 0, 1, 5, 2};
  const size_t sizes[5] = {4, 8, 1, 12, 8};
  static NSVCD_MEMORY(workspace, 256);
  char *base = (char *)workspace;
  uint64_t counted = 0;
  uint64_t laid = 0;
  for (size_t n = 0; n < 5; n++) {
    const uint64_t before = laid;
    CHECK(nsvcd__take(NULL, &counted, rows[n], sizes[n]) == NULL);
    CHECK(nsvcd__take(base, &laid, rows[n], sizes[n]) == base + before);
    CHECK_EQ(laid, counted);
    CHECK_EQ(laid % NSVCD_ALIGNMENT, 0);
    CHECK(laid >= before + rows[n] * sizes[n]);
    CHECK(laid < before + rows[n] * sizes[n] + NSVCD_ALIGNMENT);
  }
  counted = 0;
  (void)nsvcd__take(NULL, &counted, 0x20000000u, 100);
  (void)nsvcd__take(NULL, &counted, 1, 1);
  CHECK_EQ(counted, 0x20000000u * (uint64_t)100 + 8);
}

void test_memory(void) {
  RUN(memory_arrays_are_counted);
  RUN(memory_rows_follow_each_other);
}

CHECK_ALONE(test_memory)
