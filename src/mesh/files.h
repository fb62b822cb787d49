// In: an OBJ or STL file, and how its numbers become metres. Out: nsvcd_mesh.
#pragma once
#include "obj.h"
#include "stl.h"

#ifndef NSVCD_NO_READERS
NSVCDDEF nsvcd_result nsvcd_mesh_parse(const void *data, size_t size,
                                       const nsvcd_mesh_options *options,
                                       const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                       size_t *error_line) {
  nsvcd__text text;
  nsvcd_mesh out;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  if (error_line) *error_line = 0;
  if (!mesh || !data) return NSVCD_ERROR_ARGUMENT;
  memset(&out, 0, sizeof out);
  nsvcd__text_begin(&text, (const char *)data, size);
  nsvcd_result result = nsvcd__mesh_options_of(options, &text.options);
  if (result) return result;
  int is_stl = text.options.format == NSVCD_MESH_STL;
  if (text.options.format == NSVCD_MESH_ANY)
    is_stl = size == nsvcd__stl_size(data, size) || nsvcd__stl_is_solid(text);
  result = is_stl ? nsvcd__stl_read(&text, data, size, alloc, &out)
                  : nsvcd__obj_read(&text, &arena, &out);
  nsvcd__arena_free(&arena);
  if (result) {
    if (error_line) *error_line = text.line;
    nsvcd_mesh_free(&out, alloc);
    return result;
  }
  *mesh = out;
  return NSVCD_OK;
}

static const nsvcd_mesh_options nsvcd__as_obj = {NSVCD_MESH_OBJ, {0, 0, 0}, 0};
static const nsvcd_mesh_options nsvcd__as_stl = {NSVCD_MESH_STL, {0, 0, 0}, 0};

NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  return nsvcd_mesh_parse(text, size, &nsvcd__as_obj, alloc, mesh, error_line);
}

NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  return nsvcd_mesh_parse(data, size, &nsvcd__as_stl, alloc, mesh, error_line);
}

#ifndef NSVCD_NO_STDIO
// Reads a whole file into the arena.
static nsvcd_result nsvcd__read_file(const char *path, nsvcd__arena *arena, char **text,
                                     size_t *size) {
#ifdef _MSC_VER  // calls fopen unsafe, with /sdl an error
  FILE *file = NULL;
  if (fopen_s(&file, path, "rb")) return NSVCD_ERROR_IO;
#else
  FILE *file = fopen(path, "rb");
  if (!file) return NSVCD_ERROR_IO;
#endif
  // no fseek: pipes work, and a directory is an error
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
                                      const nsvcd_allocator *alloc, nsvcd_mesh *mesh,
                                      size_t *error_line) {
  char *data;
  size_t size;
  if (error_line) *error_line = 0;
  if (!path || !mesh) return NSVCD_ERROR_ARGUMENT;
  nsvcd__arena arena = nsvcd__arena_of(alloc);
  nsvcd_result result = nsvcd__read_file(path, &arena, &data, &size);
  if (!result) result = nsvcd_mesh_parse(data, size, options, alloc, mesh, error_line);
  nsvcd__arena_free(&arena);
  return result;
}

NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *alloc,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  return nsvcd_mesh_load(path, &nsvcd__as_obj, alloc, mesh, error_line);
}

NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *alloc,
                                     nsvcd_mesh *mesh, size_t *error_line) {
  return nsvcd_mesh_load(path, &nsvcd__as_stl, alloc, mesh, error_line);
}
#endif  // NSVCD_NO_STDIO
#endif  // NSVCD_NO_READERS
