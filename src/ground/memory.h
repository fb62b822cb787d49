// In: the caller's allocator, or a workspace. Out: arrays from either.
#pragma once
#include "../interface/bodies.h"
#include "points.h"

#ifndef NSVCD_NO_ENCODER
static void *nsvcd__alloc(const nsvcd_allocator *allocator, size_t size) {
  return allocator ? allocator->alloc(size, allocator->user) : malloc(size);
}
static void nsvcd__free(const nsvcd_allocator *allocator, void *memory) {
  if (allocator && memory) allocator->free(memory, allocator->user);
  if (!allocator) free(memory);
}
// count * size bytes; NULL also if that overflows.
static void *nsvcd__alloc_array(const nsvcd_allocator *allocator, size_t count, size_t size) {
  return count > SIZE_MAX / size ? NULL : nsvcd__alloc(allocator, count * size);
}

// Arrays that are freed together. `failed` says that there was no memory for one of them: it is
// checked once, after the last.
typedef union nsvcd__header {
  union nsvcd__header *next;
  double aligned;
} nsvcd__header;
typedef struct nsvcd__arena {
  const nsvcd_allocator *allocator;
  nsvcd__header *last;  // an array follows each
  int failed;
} nsvcd__arena;

static nsvcd__arena nsvcd__arena_of(const nsvcd_allocator *allocator) {
  const nsvcd__arena out = {allocator, NULL, 0};
  return out;
}
static void nsvcd__arena_free(nsvcd__arena *arena) {
  while (arena->last) {
    nsvcd__header *header = arena->last;
    arena->last = header->next;
    nsvcd__free(arena->allocator, header);
  }
}

// Uninitialized memory for an array; NULL if there is none.
static void *nsvcd__arena_room(nsvcd__arena *arena, size_t count, size_t size) {
  nsvcd__header *header = NULL;
  if (count <= (SIZE_MAX - sizeof *header) / size)
    header = (nsvcd__header *)nsvcd__alloc(arena->allocator, sizeof *header + count * size);
  if (!header) {
    arena->failed = 1;
    return NULL;
  }
  header->next = arena->last;
  arena->last = header;
  return header + 1;
}

// An array of zeros; NULL without memory.
#define NSVCD__TAKE(arena, type, count) ((type *)nsvcd__arena_take(arena, count, sizeof(type)))
static void *nsvcd__arena_take(nsvcd__arena *arena, size_t count, size_t size) {
  void *array = nsvcd__arena_room(arena, count, size);
  return array ? memset(array, 0, count * size) : NULL;
}

// Memory in place of an array (NULL: none), whose first `used` bytes it keeps; without memory the
// array stays.
static void *nsvcd__arena_grow(nsvcd__arena *arena, void *old, size_t used, size_t count,
                               size_t size) {
  nsvcd__header **at = &arena->last;
  void *larger = nsvcd__arena_room(arena, count, size);
  if (!larger || !old) return larger;
  memcpy(larger, old, used);
  while ((void *)(*at + 1) != old) at = &(*at)->next;
  nsvcd__header *header = *at;
  *at = header->next;
  nsvcd__free(arena->allocator, header);
  return larger;
}
#endif

// The next array of a workspace, or, if base is NULL, only counts its bytes: in 64 bits, because a
// 32-bit machine may not be able to address them.
static void *nsvcd__take(char *base, uint64_t *used, size_t rows, size_t row_size) {
  void *at = base ? base + *used : NULL;
  const uint64_t bytes = (uint64_t)rows * row_size;
  *used += (bytes + NSVCD_ALIGNMENT - 1) / NSVCD_ALIGNMENT * NSVCD_ALIGNMENT;
  return at;
}
#define NSVCD__TAKE_ROWS(type, rows, base, used) \
  ((type *)nsvcd__take(base, used, rows, sizeof(type)))
