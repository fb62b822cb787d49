// GLB. Of every second input the lengths of header and chunks are mended, so that what changes is seen
// by the reader of JSON, and by that of accessors.
#define FUZZ_TARGET "glb"
#define FUZZ_TOKENS                                                                              \
  "\"nodes\": [ ", "\"meshes\": [ ", "\"scenes\": [ ", "\"scene\": 0, ", "\"accessors\": [ ",     \
      "\"bufferViews\": [ ", "\"buffers\": [ ", "\"mesh\": 0, ", "\"mesh\": 1, ",                 \
      "\"children\": [ 1 ], ", "\"children\": [ 0 ], ", "\"matrix\": [ ",                         \
      "\"translation\": [ 1, 2, 3 ], ", "\"rotation\": [ 0, 0, 1, 0 ], ",                         \
      "\"scale\": [ -1, 1, 1 ], ", "\"mode\": 5, ", "\"mode\": 6, ", "\"indices\": 1, ",          \
      "\"attributes\": { ", "\"POSITION\": 0 ", "\"byteOffset\": 4, ", "\"byteStride\": 16, ",    \
      "\"componentType\": 5121, ", "\"componentType\": 5123, ", "\"componentType\": 5125, ",      \
      "\"componentType\": 5122, ", "\"normalized\": true, ", "\"type\": \"SCALAR\", ",            \
      "\"count\": 3, ", "\"bufferView\": 0, ", "\"uri\": \"a\", ", "\"extensions\": { ", "{ ",    \
      "}, ", "} ", "[ ", "], ", "] ", ", ", "0 ", "1 ", "-1 ", "1e9 ", "0.5 ", "true ", "null ",  \
      "4294967296 ", "9007199254740992 ", "1e999 ", "\"a\\\"\" ",
#include "main.h"

#include "files.h"

static void put_word(uint8_t *at, size_t word) {
  for (int k = 0; k < 4; k++)
    at[k] = (uint8_t)(word >> 8 * k);
}

// The same JSON and the same binary, told apart by what stands before the binary.
static size_t mend(const uint8_t *data, size_t size, uint8_t *out) {
  size_t from = size < 20 ? size : 20;
  size_t bin = size;
  for (size_t k = from; k + 4 <= size; k++) {
    if (memcmp(data + k, "BIN", 4) == 0)
      bin = k;
  }
  const size_t json = bin < size ? (bin - from < 4 ? 0 : bin - from - 4) : size - from;
  size_t at = 20 + json;
  memcpy(out, "glTF\2\0\0\0____....JSON", 20);
  memcpy(out + 20, data + from, json);
  while (at % 4)
    out[at++] = ' ';
  put_word(out + 12, at - 20);
  if (bin < size) {
    const size_t bytes = size - bin - 4;
    put_word(out + at, bytes);
    memcpy(out + at + 4, "BIN", 4);
    memcpy(out + at + 8, data + bin + 4, bytes);
    at += 8 + bytes;
  }
  put_word(out + 8, at);
  return at;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  nsvcd_mesh mesh;
  mesh_fault fault;
  uint8_t *whole = (uint8_t *)malloc(size + 64);
  uint8_t sum = 0;
  for (size_t k = 0; k < size; k++)
    sum ^= data[k];
  const size_t mended = whole && sum % 2 ? mend(data, size, whole) : 0;
  uint8_t *exact = mended ? (uint8_t *)malloc(mended) : NULL;  // no byte beside it
  if (exact)
    memcpy(exact, whole, mended);
  if (files_take("a.glb", exact ? exact : data, exact ? mended : size, &mesh, &fault))
    nsvcd_mesh_free(&mesh, NULL);
  free(exact);
  free(whole);
  return 0;
}
