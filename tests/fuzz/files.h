// files.h - what the targets of mesh files share: the bytes, read by examples/scenery/mesh_files.h, and
// what is accepted looked at. Include main.h first.
#ifndef NSVCD_TESTS_FUZZ_FILES_H
#define NSVCD_TESTS_FUZZ_FILES_H

#include "../../neuralsvcd.h"
#include "../../examples/scenery/mesh_files.h"
#include "../failing_heap.h"

// With the allocation of this number failing, -1 for none. Returns how many were made.
static int files_parse(const char *name, const void *data, size_t size, int fail_at,
                       nsvcd_mesh *mesh, mesh_fault *fault) {
  failing_heap heap = {0, 0, 0};
  nsvcd_allocator allocator = {failing_heap_alloc, failing_heap_free, NULL};
  const nsvcd_mesh before = {NULL, NULL, 7, 7};
  heap.fail_at = fail_at;
  allocator.user = &heap;
  *mesh = before;
  const int good = mesh_parse(name, data, size, &allocator, mesh, fault);
  FUZZ_CHECK(good == !fault->reason && fault->format);
  size_t lines = 1;
  for (size_t k = 0; k < size; k++)
    lines += ((const char *)data)[k] == '\n' || ((const char *)data)[k] == '\r';
  FUZZ_CHECK(fault->line <= lines);
  if (!good) {
    FUZZ_CHECK(!mesh->positions && !mesh->indices);
    FUZZ_CHECK(mesh->vertex_count == 7 && mesh->triangle_count == 7);
    FUZZ_CHECK(heap.live == 0);
    return heap.calls;
  }
  FUZZ_CHECK(fault->line == 0 && mesh->triangle_count > 0);
  for (size_t k = 0; k < 3 * mesh->triangle_count; k++)
    FUZZ_CHECK(mesh->indices[k] < mesh->vertex_count);
  for (size_t k = 0; k < 3 * mesh->vertex_count; k++)
    FUZZ_CHECK(fabsf(mesh->positions[k]) <= 1e6f);
  return heap.calls;
}

// Is it accepted? Then it is so again, to the bit; and without memory, at whichever place, it is
// refused.
static int files_take(const char *name, const void *data, size_t size, nsvcd_mesh *mesh,
                      mesh_fault *fault) {
  nsvcd_mesh again;
  mesh_fault other;
  const int calls = files_parse(name, data, size, -1, mesh, fault);
  files_parse(name, data, size, -1, &again, &other);
  FUZZ_CHECK(fault->reason == other.reason && fault->line == other.line);
  if (fault->reason)
    return 0;
  fuzz_taken++;
  FUZZ_CHECK(again.vertex_count == mesh->vertex_count);
  FUZZ_CHECK(again.triangle_count == mesh->triangle_count);
  FUZZ_CHECK(memcmp(again.positions, mesh->positions, 12 * again.vertex_count) == 0);
  FUZZ_CHECK(memcmp(again.indices, mesh->indices, 12 * again.triangle_count) == 0);
  nsvcd_mesh_free(&again, NULL);
  for (int k = 0; k < calls && k < 16; k++) {
    files_parse(name, data, size, k, &again, &other);
    FUZZ_CHECK(other.reason);
  }
  return 1;
}

#endif
