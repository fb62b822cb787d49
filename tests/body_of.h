// body_of.h - a shape of examples/scenery/shapes.h, encoded. After the implementation.
#ifndef NSVCD_TESTS_BODY_OF_H
#define NSVCD_TESTS_BODY_OF_H

#include "mesh_of.h"

SHAPES_DEF const nsvcd_body *body_of(shapes_mesh *shape, const nsvcd_encode_options *options) {
  nsvcd_mesh mesh = mesh_of(shape);
  const nsvcd_body *body = NULL;
  const nsvcd_result result = nsvcd_encode(&mesh, options, NULL, NULL, 0, &body);
  if (result) exit((printf("a shape is refused: %s\n", nsvcd_result_string(result)), 1));
  free(mesh.positions);
  free(mesh.indices);
  return body;
}

#endif
