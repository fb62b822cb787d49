// glb.h - a mesh from a GLB file (glTF 2.0, Khronos): the triangles of all nodes of its scene, where
// the nodes place them. Skins and morphs are not applied. Metres; glTF's y is up, and stays y.
// Include neuralsvcd.h first.
#ifndef NSVCD_SCENERY_GLB_H
#define NSVCD_SCENERY_GLB_H

#include "mesh_soup.h"
#include "json_read.h"

#define GLB_NO_MEMORY "out of memory"
#define GLB_DEPTH 64
#define GLB_JSON 0x4e4f534au
#define GLB_BIN 0x004e4942u

// Where the items of an array are.
typedef struct glb_list {
  size_t *items;  // JSON_NONE: a node that was visited
  size_t count;
} glb_list;

typedef struct glb {
  json j;
  const unsigned char *data;  // the binary chunk
  size_t size;
  int is_outside;  // the data is in another file
  glb_list accessors, views, nodes, meshes;
  size_t work, most;  // values looked at and numbers made; so many of them are enough
  mesh_soup soup;
  mesh_fault *fault;
} glb;

// A node's place in the world, column by column: three axes, and the origin.
typedef struct glb_place {
  double columns[4][3];
} glb_place;

static inline glb_place glb_compose(const glb_place *outer, const glb_place *inner) {
  glb_place out;
  for (int c = 0; c < 4; c++)
    for (int r = 0; r < 3; r++) {
      out.columns[c][r] = c == 3 ? outer->columns[3][r] : 0;
      for (int k = 0; k < 3; k++) out.columns[c][r] += outer->columns[k][r] * inner->columns[c][k];
    }
  return out;
}

// An array of the file's. 0 without memory; where there is no such array the list is empty.
static inline int glb_open_list(const json *j, const char *key, glb_list *list) {
  const size_t array = json_find(j, 0, key);
  if (!json_is(j, array, '[')) return 1;
  const size_t end = j->values[array].next;
  list->items = (size_t *)malloc((end - array) * sizeof *list->items);
  for (size_t i = array + 1; i < end && list->items; i = j->values[i].next)
    list->items[list->count++] = i;
  return list->items != NULL;
}
static inline size_t glb_item(const glb_list *list, size_t index) {
  return index < list->count ? list->items[index] : JSON_NONE;
}

// Numbers of an array of exactly so many; where there is none they stay. 0 where there is another.
static inline int glb_numbers(const glb *g, size_t array, size_t count, double *out) {
  if (array == JSON_NONE) return 1;
  if (json_item(&g->j, array, count) != JSON_NONE) return 0;
  for (size_t k = 0; k < count; k++) {
    const size_t item = json_item(&g->j, array, k);
    if (!json_is(&g->j, item, '0')) return 0;
    out[k] = json_number(&g->j, item, 0);
  }
  return 1;
}

// A node's own place: its matrix, or its translation, rotation and scale.
static inline int glb_take_place(const glb *g, size_t node, glb_place *out) {
  const size_t matrix = json_find(&g->j, node, "matrix");
  double m[16], move[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
  if (matrix != JSON_NONE) {
    if (!glb_numbers(g, matrix, 16, m)) return 0;
    for (int c = 0; c < 4; c++)
      for (int r = 0; r < 3; r++) out->columns[c][r] = m[4 * c + r];
    return 1;
  }
  if (!glb_numbers(g, json_find(&g->j, node, "translation"), 3, move) ||
      !glb_numbers(g, json_find(&g->j, node, "rotation"), 4, q) ||
      !glb_numbers(g, json_find(&g->j, node, "scale"), 3, scale))
    return 0;
  for (int c = 0; c < 3; c++) {
    // the axis, turned: a + 2 w (v x a) + 2 v x (v x a)
    const int d = (c + 1) % 3;
    const int e = (c + 2) % 3;
    out->columns[c][c] = scale[c] * (1 - 2 * (q[d] * q[d] + q[e] * q[e]));
    out->columns[c][d] = scale[c] * 2 * (q[c] * q[d] + q[3] * q[e]);
    out->columns[c][e] = scale[c] * 2 * (q[c] * q[e] - q[3] * q[d]);
    out->columns[3][c] = move[c];
  }
  return 1;
}

// Numbers in the binary chunk, rows of `columns` of them.
typedef struct glb_rows {
  const unsigned char *at;
  size_t count, stride, columns;
  size_t bytes;  // bytes of a number
  int is_real, is_signed, is_normalized;
} glb_rows;

static inline double glb_number(const glb_rows *rows, size_t row, size_t column) {
  const unsigned char *at = rows->at + row * rows->stride + column * rows->bytes;
  const uint64_t word = mesh_word(at, rows->bytes, 0);
  if (rows->is_real) {
    const uint32_t bits = (uint32_t)word;
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
  }
  const double past = ldexp(1, 8 * (int)rows->bytes);
  double value = (double)word;
  if (rows->is_signed && value >= past / 2) value -= past;
  if (!rows->is_normalized) return value;
  return fmax(-1, value / (rows->is_signed ? past / 2 - 1 : past - 1));
}

// A small file may name a mesh many times, and in it what is long. Returns 0 with a reason.
static inline int glb_afford(glb *g, size_t work) {
  g->work += work;
  return g->work <= g->most ||
         mesh_refuse(g->fault, "it names the same things too many times: too large");
}
static inline size_t glb_extent(const json *j, size_t i) {
  return i == JSON_NONE ? 0 : j->values[i].next - i;
}

// An accessor, every byte of which is in the file. Returns 0 with a reason.
static inline int glb_access(glb *g, size_t index, const char *type, glb_rows *rows) {
  const json *j = &g->j;
  const size_t accessor = glb_item(&g->accessors, index);
  const size_t kind = json_find(j, accessor, "type");
  const size_t view = glb_item(&g->views, json_whole(j, json_find(j, accessor, "bufferView")));
  const size_t component = json_whole(j, json_find(j, accessor, "componentType"));
  if (!json_is(j, kind, '"') || j->values[kind].length != strlen(type) ||
      memcmp(j->values[kind].at, type, strlen(type)) != 0)
    return mesh_refuse(g->fault, "an accessor that is not there, or of another type");
  if (json_find(j, accessor, "sparse") != JSON_NONE)
    return mesh_refuse(g->fault, "sparse accessors are not read");
  if (view == JSON_NONE)
    return mesh_refuse(g->fault, "an accessor without data: compressed? save it without that");
  if (!glb_afford(g, glb_extent(j, accessor) + glb_extent(j, view))) return 0;
  const size_t extensions = json_find(j, view, "extensions");
  if (json_find(j, extensions, "EXT_meshopt_compression") != JSON_NONE ||
      json_find(j, extensions, "KHR_meshopt_compression") != JSON_NONE)
    return mesh_refuse(g->fault, "compressed (meshopt): save it without compression");
  if (component < 5120 || component > 5126 || component == 5124)
    return mesh_refuse(g->fault, "a type of numbers that glTF does not have");
  rows->columns = type[0] == 'V' ? 3 : 1;
  rows->bytes = component < 5122 ? 1 : component < 5124 ? 2 : 4;
  rows->is_real = component == 5126;
  rows->is_signed = component == 5120 || component == 5122;
  rows->is_normalized = json_is(j, json_find(j, accessor, "normalized"), 't');
  rows->count = json_whole(j, json_find(j, accessor, "count"));
  const size_t row = rows->columns * rows->bytes;
  const size_t told = json_find(j, view, "byteStride");
  rows->stride = told == JSON_NONE ? row : json_whole(j, told);
  if (type[0] == 'S' && (rows->is_real || rows->is_signed || rows->is_normalized))
    return mesh_refuse(g->fault, "indices of a type that indices do not have");
  if (json_whole(j, json_find(j, view, "buffer")) != 0 || g->is_outside)
    return mesh_refuse(g->fault, "its data is in another file");
  const size_t places[3] = {json_find(j, accessor, "byteOffset"), json_find(j, view, "byteOffset"),
                            json_find(j, view, "byteLength")};
  size_t offsets[3];
  for (int k = 0; k < 3; k++) {
    offsets[k] = places[k] == JSON_NONE ? 0 : json_whole(j, places[k]);
    if (offsets[k] > g->size) return mesh_refuse(g->fault, "an offset outside of the file");
  }
  if (offsets[2] > g->size - offsets[1] || offsets[0] > offsets[2])
    return mesh_refuse(g->fault, "an offset outside of the file");
  const size_t left = offsets[2] - offsets[0];
  if (rows->stride < row || rows->stride > 65536)
    return mesh_refuse(g->fault, "a stride that is too short or too long");
  if (rows->count == 0 || row > left || rows->count - 1 > (left - row) / rows->stride)
    return mesh_refuse(g->fault, "an accessor that ends outside of its data");
  rows->at = g->data + offsets[1] + offsets[0];
  return 1;
}

// One corner of a triangle, by its number in the order of drawing.
static inline int glb_corner(glb *g, const glb_rows *indices, size_t i, size_t first,
                             size_t count) {
  const double index = indices->at ? glb_number(indices, i, 0) : (double)i;
  if (!(index < (double)count)) return mesh_refuse(g->fault, "an index beyond the vertices");
  return mesh_soup_corner(&g->soup, (uint32_t)(first + (size_t)index)) ||
         mesh_refuse(g->fault, GLB_NO_MEMORY);
}

// Triangles, or a strip or fan of them, at their place.
static inline int glb_primitive(glb *g, size_t primitive, const glb_place *place) {
  const json *j = &g->j;
  const size_t told = json_find(j, primitive, "mode");
  const size_t mode = told == JSON_NONE ? 4 : json_whole(j, told);
  const size_t by_index = json_find(j, primitive, "indices");
  const size_t attributes = json_find(j, primitive, "attributes");
  const size_t position = json_whole(j, json_find(j, attributes, "POSITION"));
  glb_rows positions, indices;
  memset(&indices, 0, sizeof indices);
  if (mode < 4) return 1;  // points and lines
  if (mode > 6) return mesh_refuse(g->fault, "a mode of drawing that glTF does not have");
  if (json_find(j, json_find(j, primitive, "extensions"), "KHR_draco_mesh_compression") !=
      JSON_NONE)
    return mesh_refuse(g->fault, "compressed (Draco): save it without compression");
  if (!glb_access(g, position, "VEC3", &positions)) return 0;
  if (by_index != JSON_NONE && !glb_access(g, json_whole(j, by_index), "SCALAR", &indices))
    return 0;
  const size_t first = g->soup.vertices;
  const size_t corners = indices.at ? indices.count : positions.count;
  if (positions.count > 0x7fffffff - first || corners > 0x7fffffff)
    return mesh_refuse(g->fault, "more vertices than the library takes");
  if (!glb_afford(g, 3 * positions.count + (mode == 4 ? 1u : 3u) * corners)) return 0;
  for (size_t i = 0; i < positions.count; i++) {
    double world[3];
    for (int r = 0; r < 3; r++) {
      world[r] = place->columns[3][r];
      for (size_t k = 0; k < 3; k++)
        world[r] += place->columns[k][r] * glb_number(&positions, i, k);
    }
    if (!mesh_soup_vertex(&g->soup, world)) return mesh_refuse(g->fault, GLB_NO_MEMORY);
  }
  double normal[3];
  const double(*c)[3] = place->columns;
  for (int k = 0; k < 3; k++)
    normal[k] = c[0][(k + 1) % 3] * c[1][(k + 2) % 3] - c[0][(k + 2) % 3] * c[1][(k + 1) % 3];
  const int mirrored = normal[0] * c[2][0] + normal[1] * c[2][1] + normal[2] * c[2][2] < 0;
  for (size_t i = 0; i + 2 < corners; i += mode == 4 ? 3 : 1) {
    const size_t turn = (mode == 5 && i % 2 ? 1u : 0u) ^ (size_t)mirrored;
    if (!glb_corner(g, &indices, mode == 6 ? 0 : i, first, positions.count) ||
        !glb_corner(g, &indices, i + 1 + turn, first, positions.count) ||
        !glb_corner(g, &indices, i + 2 - turn, first, positions.count))
      return 0;
    if (!mesh_soup_face(&g->soup, 3)) return mesh_refuse(g->fault, GLB_NO_MEMORY);
  }
  return 1;
}

// A node, and those below it. Each has one parent, or is a root: there are no rings.
static inline int glb_node(glb *g, size_t index, const glb_place *parent, int depth) {
  const json *j = &g->j;
  const size_t node = glb_item(&g->nodes, index);
  const size_t mesh = json_find(j, node, "mesh");
  const size_t children = json_find(j, node, "children");
  glb_place own, place;
  if (node == JSON_NONE)
    return mesh_refuse(g->fault, "a node that is not there, or is named twice");
  g->nodes.items[index] = JSON_NONE;
  if (depth > GLB_DEPTH) return mesh_refuse(g->fault, "nodes below nodes, more than 64 deep");
  if (json_find(j, json_find(j, node, "extensions"), "EXT_mesh_gpu_instancing") != JSON_NONE)
    return mesh_refuse(g->fault, "instances of a node are not read");
  if (!glb_take_place(g, node, &own)) return mesh_refuse(g->fault, "a node with a broken place");
  place = glb_compose(parent, &own);
  if (mesh != JSON_NONE) {
    const size_t drawn = glb_item(&g->meshes, json_whole(j, mesh));
    const size_t primitives = json_find(j, drawn, "primitives");
    if (!json_is(j, primitives, '[')) return mesh_refuse(g->fault, "a mesh that is not there");
    if (!glb_afford(g, glb_extent(j, drawn))) return 0;
    for (size_t i = primitives + 1; i < j->values[primitives].next; i = j->values[i].next) {
      if (!glb_primitive(g, i, &place)) return 0;
    }
  }
  if (!json_is(j, children, '[')) return 1;
  for (size_t i = children + 1; i < j->values[children].next; i = j->values[i].next) {
    if (!glb_node(g, json_whole(j, i), &place, depth + 1)) return 0;
  }
  return 1;
}

// Takes all roots of the scene that is shown.
static inline int glb_scene(glb *g) {
  const glb_place world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
  const json *j = &g->j;
  const size_t told = json_find(j, 0, "scene");
  const size_t scenes = json_find(j, 0, "scenes");
  const size_t scene = json_item(j, scenes, told == JSON_NONE ? 0 : json_whole(j, told));
  const size_t roots = json_find(j, scene, "nodes");
  const size_t buffer = json_item(j, json_find(j, 0, "buffers"), 0);
  g->is_outside = json_find(j, buffer, "uri") != JSON_NONE;
  if (!glb_open_list(j, "accessors", &g->accessors) ||
      !glb_open_list(j, "bufferViews", &g->views) || !glb_open_list(j, "nodes", &g->nodes) ||
      !glb_open_list(j, "meshes", &g->meshes))
    return mesh_refuse(g->fault, GLB_NO_MEMORY);
  if (!json_is(j, roots, '[')) return mesh_refuse(g->fault, "it holds no scene");
  for (size_t i = roots + 1; i < j->values[roots].next; i = j->values[i].next) {
    if (!glb_node(g, json_whole(j, i), &world, 0)) return 0;
  }
  return g->soup.faces || mesh_refuse(g->fault, "its scene holds no triangles");
}

// The two chunks. Returns 0 with a reason.
static inline int glb_chunks(glb *g, const unsigned char *data, size_t size) {
  size_t at = 12;
  const uint64_t length = size < 12 ? 0 : mesh_word(data + 8, 4, 0);
  if (size < 20 || length < 20 || length > size)
    return mesh_refuse(g->fault, "it is shorter than its header says");
  if (mesh_word(data + 4, 4, 0) != 2) return mesh_refuse(g->fault, "not of version 2 of glTF");
  for (int chunk = 0; chunk < 2 && length - at >= 8; chunk++) {
    const size_t bytes = (size_t)mesh_word(data + at, 4, 0);
    const uint64_t kind = mesh_word(data + at + 4, 4, 0);
    at += 8;
    if (bytes > length - at) return mesh_refuse(g->fault, "a chunk that ends outside of the file");
    if (kind != (chunk ? GLB_BIN : GLB_JSON))
      return mesh_refuse(g->fault, "chunks that are not JSON, then binary");
    if (chunk) g->data = data + at;
    if (chunk) g->size = bytes;
    if (!chunk && !json_parse(&g->j, (const char *)data + at, bytes))
      return mesh_refuse(g->fault, "what describes it is no JSON, or too long");
    at += (bytes + 3) / 4 * 4;
    if (at > length) break;
  }
  return 1;
}

// Returns 1, or 0 with a reason in *fault.
static inline int glb_parse(const void *data, size_t size, const nsvcd_mesh_options *options,
                            const nsvcd_allocator *allocator, nsvcd_mesh *mesh, mesh_fault *fault) {
  glb g;
  memset(&g, 0, sizeof g);
  g.fault = fault;
  g.soup.options = options;
  g.most = ((size_t)1 << 24) + (size > SIZE_MAX / 64 ? SIZE_MAX / 2 : 32 * size);
  const int good = glb_chunks(&g, (const unsigned char *)data, size) && glb_scene(&g) &&
                   mesh_soup_finish(&g.soup, allocator, mesh, fault);
  free(g.j.values);
  free(g.accessors.items);
  free(g.views.items);
  free(g.nodes.items);
  free(g.meshes.items);
  mesh_soup_free(&g.soup);
  return good;
}

#endif
