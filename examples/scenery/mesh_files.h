// mesh_files.h - a mesh from the bytes of a file: OBJ, STL, PLY or GLB. The bytes tell which, or
// else the file's name. No stdio. Include neuralsvcd.h first.
//
//   mesh_fault fault;
//   if (!mesh_parse("part.ply", data, size, NULL, &mesh, &fault))
//     printf("%s, line %zu: %s\n", fault.format, fault.line, fault.reason);
#ifndef NSVCD_SCENERY_MESH_FILES_H
#define NSVCD_SCENERY_MESH_FILES_H

#include "mesh_soup.h"
#include "ply.h"
#include "glb.h"

// What follows the last point of a name, in small letters; "" if that is longer than 7.
static inline void mesh_ending(const char *name, char out[8]) {
  const char *dot = strrchr(name, '.');
  const size_t length = dot ? strlen(dot + 1) : 8;
  memset(out, 0, 8);
  for (size_t i = 0; i < length && length < 8; i++) {
    const char c = dot[1 + i];
    out[i] = (char)(c >= 'A' && c <= 'Z' ? c + 32 : c);
  }
}

// The format of a file: "OBJ" if nothing tells, NULL if it is known not to be read. A new format
// needs a line here, and its reader in mesh_parse_to.
static inline const char *mesh_format(const char *name, const unsigned char *data, size_t size) {
  static const char *const others[] = {"fbx", "dae",  "3ds", "step",  "stp",  "iges", "igs",
                                       "usd", "usdz", "3mf", "blend", "gltf", "off"};
  char ending[8];
  mesh_ending(name, ending);
  if (size >= 4 && memcmp(data, "glTF", 4) == 0) return "GLB";
  if (size >= 4 && memcmp(data, "ply", 3) == 0 && (data[3] == '\n' || data[3] == '\r'))
    return "PLY";
  if (strcmp(ending, "glb") == 0) return "GLB";
  if (strcmp(ending, "ply") == 0) return "PLY";
  if (strcmp(ending, "stl") == 0) return "STL";
  if (strcmp(ending, "obj") == 0) return "OBJ";
  for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
    if (strcmp(ending, others[i]) == 0) return NULL;
  }
  if (size >= 84 && size == 84 + 50 * mesh_word(data + 80, 4, 0)) return "STL";
  return size >= 6 && memcmp(data, "solid ", 6) == 0 ? "STL" : "OBJ";
}

// Reads an STL. Refuses a file that is longer than its count of triangles says: the library would
// take it, and lose triangles.
static inline int mesh_take_stl(const unsigned char *data, size_t size,
                                const nsvcd_mesh_options *options, const nsvcd_allocator *allocator,
                                nsvcd_mesh *mesh, mesh_fault *fault) {
  const int is_binary = size >= 84 && memchr(data, 0, size);  // no text holds a NUL
  const uint64_t needed = is_binary ? 84 + 50 * mesh_word(data + 80, 4, 0) : 0;
  if (is_binary && size >= needed + 50)
    return mesh_refuse(fault, "it is longer than its count of triangles says");
  const nsvcd_result result = nsvcd_mesh_parse(data, size, options, allocator, mesh, &fault->line);
  if (result == NSVCD_ERROR_FORMAT || (result && size < needed)) {
    fault->line = 0;
    return mesh_refuse(fault, is_binary ? "it is shorter than its count of triangles says"
                                        : "it is no STL, of which text begins with 'solid'");
  }
  return !result || mesh_refuse(fault, nsvcd_result_string(result));
}

// Reads a mesh. Returns 1, or 0 with a reason in *fault. name: the file's, or "". data: (size)
// bytes, not NULL. given: how numbers become metres; NULL: they are. Its format is not used.
static inline int mesh_parse_to(const char *name, const void *data, size_t size,
                                const nsvcd_mesh_options *given, const nsvcd_allocator *allocator,
                                nsvcd_mesh *mesh, mesh_fault *fault) {
  const char *bytes = (const char *)data;
  nsvcd_mesh_options options;
  memset(&options, 0, sizeof options);
  if (given) options = *given;
  memset(fault, 0, sizeof *fault);
  fault->format = mesh_format(name, (const unsigned char *)data, size);
  if (!fault->format) {
    fault->format = "none of these";
    return mesh_refuse(fault, "OBJ, STL, PLY and GLB are read, and no other: convert it");
  }
  if (strcmp(fault->format, "GLB") == 0) {
    if (size >= 4 && memcmp(bytes, "glTF", 4) == 0)
      return glb_parse(data, size, &options, allocator, mesh, fault);
    return mesh_refuse(fault, "it does not begin with 'glTF', as a GLB does");
  }
  if (strcmp(fault->format, "PLY") == 0) {
    if (size >= 4 && memcmp(bytes, "ply", 3) == 0)
      return ply_parse(bytes, size, &options, allocator, mesh, fault);
    return mesh_refuse(fault, "it does not begin with 'ply', as a PLY does");
  }
  options.format = strcmp(fault->format, "STL") == 0 ? NSVCD_MESH_STL : NSVCD_MESH_OBJ;
  if (options.format == NSVCD_MESH_STL)
    return mesh_take_stl((const unsigned char *)data, size, &options, allocator, mesh, fault);
  const nsvcd_result result = nsvcd_mesh_parse(data, size, &options, allocator, mesh, &fault->line);
  return !result || mesh_refuse(fault, nsvcd_result_string(result));
}
static inline int mesh_parse(const char *name, const void *data, size_t size,
                             const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                             mesh_fault *fault) {
  return mesh_parse_to(name, data, size, NULL, allocator, mesh, fault);
}

#endif
