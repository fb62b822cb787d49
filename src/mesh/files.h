// In: an OBJ or STL file, and how its numbers become metres. Out: nsvcd_mesh.
#pragma once
#include "stl.h"

#ifndef NSVCD_NO_OBJ
// Is it an STL: does it begin with "solid", or has it the size that its count of triangles says?
static int nsvcd__is_stl(const void *data, size_t size) {
  const unsigned char *bytes = (const unsigned char *)data;
  nsvcd__obj text;
  nsvcd__obj_begin(&text, (const char *)data, size);
  if (nsvcd__stl_token(&text) && nsvcd__stl_accept(&text, "solid")) return 1;
  return size >= NSVCD__STL_HEADER &&
         size == NSVCD__STL_HEADER + NSVCD__STL_FACET * (uint64_t)nsvcd__stl_word(bytes + 80);
}

NSVCDDEF nsvcd_result nsvcd_mesh_parse(const void *data, size_t size,
                                       const nsvcd_mesh_options *options,
                                       const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                       size_t *error_line) {
  const nsvcd_mesh_format format = options ? options->format : NSVCD_MESH_ANY;
  const int stl = format == NSVCD_MESH_ANY && data && nsvcd__is_stl(data, size);
  if (stl || format == NSVCD_MESH_STL)
    return nsvcd__stl_read(data, size, options, allocator, mesh, error_line);
  return nsvcd__obj_read((const char *)data, size, options, allocator, mesh, error_line);
}

#ifndef NSVCD_NO_STDIO
// What a file holds; in the arena.
static nsvcd_result nsvcd__read_file(const char *path, nsvcd__arena *arena, char **text,
                                     size_t *size) {
#ifdef _MSC_VER  // where fopen is called unsafe, with /sdl an error
  FILE *file = NULL;
  if (fopen_s(&file, path, "rb")) return NSVCD_ERROR_IO;
#else
  FILE *file = fopen(path, "rb");
  if (!file) return NSVCD_ERROR_IO;
#endif
  // No fseek, so that pipes work and a directory is an error.
  size_t capacity = 32768;
  *text = NULL;
  *size = 0;
  do {
    capacity = capacity <= SIZE_MAX / 2 ? 2 * capacity : SIZE_MAX;
    *text = (char *)nsvcd__arena_grow(arena, *text, *size, capacity, 1);
    if (*text) *size += fread(*text + *size, 1, capacity - *size, file);
  } while (*text && *size == capacity);
  nsvcd_result result = *text ? NSVCD_OK : NSVCD_ERROR_MEMORY;
  if (*text && ferror(file)) result = NSVCD_ERROR_IO;
  fclose(file);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_mesh_load(const char *path, const nsvcd_mesh_options *options,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  char *data;
  size_t size;
  if (error_line) *error_line = 0;
  if (!path || !mesh) return NSVCD_ERROR_ARGUMENT;
  nsvcd__arena arena = nsvcd__arena_of(allocator);
  nsvcd_result result = nsvcd__read_file(path, &arena, &data, &size);
  if (!result) result = nsvcd_mesh_parse(data, size, options, allocator, mesh, error_line);
  nsvcd__arena_free(&arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  const nsvcd_mesh_options as = {NSVCD_MESH_OBJ, {0, 0, 0}, 0};
  return nsvcd_mesh_load(path, &as, allocator, mesh, error_line);
}

NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  const nsvcd_mesh_options as = {NSVCD_MESH_STL, {0, 0, 0}, 0};
  return nsvcd_mesh_load(path, &as, allocator, mesh, error_line);
}
#endif  // NSVCD_NO_STDIO
#endif  // NSVCD_NO_OBJ
