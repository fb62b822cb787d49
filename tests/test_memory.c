// Arrays from an allocator, and rows of a workspace: sizes that cannot be counted, and alignment.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/interface/queries.h"
#include "../src/ground/memory.h"

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
    if (most == SIZE_MAX) continue;
    CHECK(nsvcd__alloc_array(&allocator, most + 1, sizes[n]) == NULL);
    CHECK(nsvcd__alloc_array(&allocator, SIZE_MAX, sizes[n]) == NULL);
    CHECK_EQ(log.calls, calls);
  }
  nsvcd__free(&allocator, &log);
  nsvcd__free(&allocator, NULL);  // of which a caller's function need not know
  CHECK_EQ(log.freed, 1);
  CHECK(nsvcd__alloc_array(NULL, SIZE_MAX, 2) == NULL);
  nsvcd__free(NULL, nsvcd__alloc_array(NULL, 3, 8));
}

static void *memory_real(size_t size, void *user) {
  memory_log *log = (memory_log *)user;
  log->size = size;
  if (log->calls++ == 4) return NULL;
  unsigned char *memory = (unsigned char *)malloc(size);
  memset(memory, 0xa5, size);
  return memory;
}
static void memory_real_free(void *memory, void *user) {
  ((memory_log *)user)->freed++;
  free(memory);
}

// Arrays of an arena are zeros and apart, one takes another's place, all are given back; what
// cannot be counted, or had, is said to have failed.
static void memory_arenas_give_all_back(void) {
  memory_log log = {0, 0, 0};
  const nsvcd_allocator allocator = {memory_real, memory_real_free, &log};
  nsvcd__arena arena = nsvcd__arena_of(&allocator);
  double *numbers = NSVCD__TAKE(&arena, double, 7);
  CHECK(numbers && log.size >= 7 * sizeof *numbers && log.size <= 9 * sizeof *numbers);
  CHECK_EQ((uintptr_t)numbers % NSVCD_ALIGNMENT, 0);
  uint8_t *bytes = NSVCD__TAKE(&arena, uint8_t, 3);
  CHECK(bytes && NSVCD__TAKE(&arena, uint32_t, 0));
  for (size_t i = 0; i < 7; i++) CHECK_EQ(numbers[i], 0);
  for (size_t i = 0; i < 3; i++) CHECK_EQ(bytes[i], 0);
  for (size_t i = 0; i < 7; i++) numbers[i] = (double)i;
  bytes[2] = 9;
  numbers = (double *)nsvcd__arena_grow(&arena, numbers, 7 * sizeof *numbers, 20, sizeof *numbers);
  CHECK(numbers && log.calls == 4 && log.freed == 1 && bytes[2] == 9);
  for (size_t i = 0; i < 7; i++) CHECK_EQ(numbers[i], (double)i);
  for (size_t i = 7; i < 20; i++) numbers[i] = 0;
  CHECK_EQ(arena.failed, 0);

  CHECK(!nsvcd__arena_grow(&arena, numbers, 20 * sizeof *numbers, 40, sizeof *numbers));
  CHECK(arena.failed && log.calls == 5 && log.freed == 1);
  CHECK_EQ(numbers[6], 6);
  nsvcd__arena_free(&arena);
  CHECK_EQ(log.freed, 4);
  nsvcd__arena_free(&arena);
  CHECK_EQ(log.freed, 4);

  for (size_t size = 1; size <= 24; size++) {
    const size_t most = (SIZE_MAX - sizeof(nsvcd__header)) / size;
    nsvcd__arena none = nsvcd__arena_of(&allocator);
    const int calls = log.calls;
    CHECK(!nsvcd__arena_take(&none, most + 1, size) && none.failed);
    CHECK(!nsvcd__arena_take(&none, SIZE_MAX, size));
    CHECK_EQ(log.calls, calls);
  }
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
  RUN(memory_arenas_give_all_back);
  RUN(memory_rows_follow_each_other);
}

CHECK_ALONE(test_memory)
