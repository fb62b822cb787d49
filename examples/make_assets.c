// make_assets.c - writes the meshes of the examples, closed and in metres: a mug and a dish rack, and
// a plate (`make assets`).
#include "scenery/shapes.h"

static int write_asset(shapes_mesh *mesh, const char *folder, const char *name) {
  char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  int good = !mesh->failed && shapes_write_obj(mesh, path);
  if (good) printf("%s: %zu vertices, %zu triangles\n", path, mesh->vertices, mesh->triangles);
  if (!good) fprintf(stderr, "make_assets: %s cannot be written\n", path);
  shapes_free(mesh);
  return good;
}

int main(int argc, char **argv) {
  const char *folder = argc > 1 ? argv[1] : "examples/assets";
  shapes_mesh mug, rack, plate;
  memset(&mug, 0, sizeof mug);
  memset(&rack, 0, sizeof rack);
  memset(&plate, 0, sizeof plate);
  // radius, height, wall: the handle points along x
  shapes_mug(&mug, 0.041, 0.095, 0.005, 40);
  // length, width, height, wire, reach: two rows of eight prongs
  shapes_dish_rack(&rack, 0.40, 0.30, 0.12, 0.003, 0.002, 8, 8);
  // radius, height, wall
  shapes_plate(&plate, 0.11, 0.02, 0.003, 40);
  int good = write_asset(&mug, folder, "mug.obj");
  good = write_asset(&rack, folder, "dish_rack.obj") && good;
  good = write_asset(&plate, folder, "plate.obj") && good;
  return !good;
}
