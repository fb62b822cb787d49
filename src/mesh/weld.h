// In: positions of vertices. Out: for each vertex, the first one at the same position.
#pragma once
#include "../ground/memory.h"

#ifndef NSVCD_NO_ENCODER
// A hash table of vertices by position, with open addressing.
typedef struct nsvcd__weld {
  const float *positions;
  // (slots), a power of two: numbers of vertices + 1, or 0
  uint32_t *table;
  size_t slots;
  uint64_t seed;  // of the hash
  // past other vertices
  size_t steps;
} nsvcd__weld;

// The slot of the vertex at the position of vertex v, or the empty one where it belongs.
static uint32_t *nsvcd__weld_slot(nsvcd__weld *w, size_t v) {
  const float *at = w->positions + 3 * v;
  uint64_t hash = w->seed;
  for (size_t k = 0; k < 3; k++) {
    uint32_t bits;
    memcpy(&bits, at + k, sizeof bits);
    // -0 equals 0
    if (bits == 0x80000000u) bits = 0;
    hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 32;
  }
  for (size_t slot = (size_t)hash;; slot++, w->steps++) {
    uint32_t *out = &w->table[slot & (w->slots - 1)];
    if (!*out) return out;
    const float *other = w->positions + 3 * (size_t)(*out - 1);
    if (other[0] == at[0] && other[1] == at[1] && other[2] == at[2]) return out;
  }
}

// Writes welded (count). If it takes many steps, as with vertices chosen to share a hash, it takes
// another hash. The table is zeros.
static void nsvcd__weld_vertices(nsvcd__weld *w, size_t count, uint32_t *welded) {
  for (uint32_t v = 0; v < count; v++) {
    const size_t most = 8 * (size_t)v + 1024;
    uint32_t *slot = nsvcd__weld_slot(w, v);
    if (!*slot) *slot = v + 1;
    welded[v] = *slot - 1;
    while (w->steps > most) {
      // whoever made the mesh cannot know this address
      w->seed += UINT64_C(0xd1342543de82ef95) + (uint64_t)(size_t)w->table;
      w->steps = 0;
      memset(w->table, 0, w->slots * sizeof *w->table);
      for (uint32_t u = 0; u <= v && w->steps <= most; u++)
        if (welded[u] == u) *nsvcd__weld_slot(w, u) = u + 1;
    }
  }
}

// nsvcd__weld_vertices with a table of its own. 0 without memory.
static int nsvcd__weld_all(const float *positions, size_t count, uint32_t *welded,
                           const nsvcd_allocator *alloc) {
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  nsvcd__weld w = {positions, NULL, 16, 0, 0};
  while (w.slots / 2 < count) w.slots *= 2;
  w.table = NSVCD__TAKE(&arena, uint32_t, w.slots);
  if (w.table) nsvcd__weld_vertices(&w, count, welded);
  nsvcd__arena_free(&arena);
  return !arena.failed;
}
#endif  // NSVCD_NO_ENCODER
