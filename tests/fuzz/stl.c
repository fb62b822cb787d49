// STL, text and binary. What is accepted is counted a second time: of what is binary each corner is
// where its bytes say; a text has at least as many vertices as the mesh has corners.
#define FUZZ_TARGET "stl"
#define FUZZ_TOKENS                                                                              \
  "solid a\n", "solid ", "endsolid a\n", "facet normal 0 0 1\n", "outer loop\n", "endloop\n",     \
      "endfacet\n", "vertex 0 0 0\n", "vertex 1 0 0\n", "vertex 0 1 0\n", "vertex ", "VERTEX ",   \
      "-0 ", "1e-5 ", "1e38 ", ".5 ", "nan ", "\r\n", "\\\n", "#\n", "\t", "0 0 1",
#include "main.h"

#include "files.h"

static int is_binary(const uint8_t *data, size_t size, const nsvcd_mesh *mesh) {
  if (size < 84 || mesh_word(data + 80, 4, 0) != mesh->triangle_count ||
      size < 84 + 50 * mesh->triangle_count)
    return 0;
  for (size_t k = 0; k < 9 * mesh->triangle_count; k++) {
    float value;
    memcpy(&value, data + 84 + 50 * (k / 9) + 12 + 4 * (k % 9), sizeof value);
    if (value != mesh->positions[3 * mesh->indices[k / 3] + k % 3])
      return 0;
  }
  return 1;
}

static size_t words(const uint8_t *data, size_t size, const char *word) {
  const size_t length = strlen(word);
  size_t count = 0;
  for (size_t k = 0; k + length <= size; k++) {
    size_t same = 0;
    while (same < length && (data[k + same] | 32) == word[same])
      same++;
    count += same == length;
  }
  return count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  nsvcd_mesh mesh;
  mesh_fault fault;
  if (!files_take("a.stl", data, size, &mesh, &fault))
    return 0;
  if (fault.format[0] == 'S' && !is_binary(data, size, &mesh)) {
    FUZZ_CHECK(words(data, size, "vertex") >= 3 * mesh.triangle_count);
    FUZZ_CHECK(words(data, size, "endloop") >= mesh.triangle_count);
  }
  FUZZ_CHECK(mesh.vertex_count <= 3 * mesh.triangle_count || fault.format[0] != 'S');
  nsvcd_mesh_free(&mesh, NULL);
  return 0;
}
