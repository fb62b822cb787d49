// bake.c - encodes meshes on the host, and writes the bodies as C arrays for a microcontroller.
//
//   bake proof|network|both POINTS OUT.h [--scale S] IN.obj|IN.stl ...
//
// --scale: metres in a unit of the files after it, 0.001 of millimetres.
// proof: triangles, no latents. network: latents, no triangles. both: both. The array of
// parts/my-mug.obj is named my_mug_body. BODIES_PATCHES is the most patches that one of them has.
// Exit status: 0 done, 1 a file was refused, 2 usage.
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

// "parts/my-mug.obj" -> "my_mug". Returns 0 if the name is too long.
static int name_of(const char *path, char *name, size_t size) {
  const char *slash = strrchr(path, '/');
  const char *base = slash ? slash + 1 : path;
  const size_t length = strcspn(base, ".");
  if (length >= size) return 0;
  for (size_t i = 0; i < length; i++) {
    name[i] = base[i];
    if (!isalnum((unsigned char)base[i])) name[i] = '_';
  }
  name[length] = 0;
  return 1;
}

// Writes a body as words of 8 bytes: it has to be aligned so, and C99 has no other way to say it.
static void write_body(FILE *file, const char *path, const char *name, const nsvcd_body *body) {
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  const unsigned char *bytes = (const unsigned char *)body;
  const unsigned long words = (unsigned long)((facts.size + 7) / 8);
  fprintf(file, "\n// %s: %lu patches, %lu triangles, %lu bytes.\n", path,
          (unsigned long)facts.patches, (unsigned long)facts.triangles, (unsigned long)facts.size);
  fprintf(file, "static const uint64_t %s_body[%lu] = {", name, words);
  for (size_t i = 0; i < facts.size; i += 8) {
    fprintf(file, "%s0x", i % 32 ? " " : "\n    ");
    for (size_t k = 8; k-- > 0;) {  // the last byte first: little-endian
      fprintf(file, "%02x", i + k < facts.size ? bytes[i + k] : 0u);
    }
    fprintf(file, ",");
  }
  fprintf(file, "\n};\n");
}

// Loads, encodes and writes one mesh. most: patches of a body so far, at most.
static int bake(FILE *file, const char *path, double scale, const nsvcd_encode_options *options,
                size_t *most) {
  nsvcd_mesh_options units = {0};
  char name[64];
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  if (!name_of(path, name, sizeof name)) {
    fprintf(stderr, "bake: %s: the name is too long\n", path);
    return 0;
  }
  units.scale = scale;
  nsvcd_result result = nsvcd_mesh_load(path, &units, NULL, &mesh, NULL);
  if (!result) {
    result = nsvcd_encode(&mesh, options, NULL, NULL, 0, &body);
    nsvcd_mesh_free(&mesh, NULL);
  }
  if (result) {
    fprintf(stderr, "bake: %s: %s\n", path, nsvcd_result_string(result));
    return 0;
  }
  write_body(file, path, name, body);
  const size_t points = nsvcd_body_describe(body).patches;
  if (points > *most) *most = points;
  nsvcd_body_free(body, NULL);
  return 1;
}

int main(int argc, char **argv) {
  if (argc < 5) {
    fprintf(stderr, "bake proof|network|both POINTS OUT.h [--scale S] IN.obj|IN.stl ...\n");
    return 2;
  }
  nsvcd_encode_options options = {0};
  options.latents = strcmp(argv[1], "both") == 0;
  options.no_triangles = strcmp(argv[1], "network") == 0;
  options.patches = (size_t)strtoul(argv[2], NULL, 10);
  FILE *file = fopen(argv[3], "w");
  if (!file) {
    fprintf(stderr, "bake: %s: cannot be written\n", argv[3]);
    return 1;
  }
  fprintf(file, "// Written by bake.c, for %s. Little-endian only.\n", argv[1]);
  fprintf(file, "#include <stdint.h>\n");
  int good = 1;
  size_t most = 0;
  double scale = 1;
  for (int i = 4; i < argc && good; i++) {
    if (strcmp(argv[i], "--scale") == 0 && i + 1 < argc)
      good = (scale = strtod(argv[++i], NULL)) > 0;
    else
      good = bake(file, argv[i], scale, &options, &most);
  }
  fprintf(file, "\n#define BODIES_PATCHES %lu\n", (unsigned long)most);
  good &= !ferror(file);
  if (fclose(file) != 0) good = 0;
  if (!good) remove(argv[3]);
  return good ? 0 : 1;
}
