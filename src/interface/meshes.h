// In: an OBJ or STL file, or faces of the caller. Out: nsvcd_mesh, or a part of one.
#pragma once
#include "results.h"

typedef struct nsvcd_mesh {
  // (vertex_count, 3) metres
  float *positions;
  // (triangle_count, 3) vertices, counter-clockwise from outside
  uint32_t *indices;
  size_t vertex_count;
  size_t triangle_count;
} nsvcd_mesh;

#ifndef NSVCD_NO_OBJ
// Reads OBJ text into a mesh. Only lines v and f matter; they end in LF, CR or CR LF. Corners of a
// face are v, v/vt, v//vn or v/vt/vn, what follows a slash may be missing, and they may refer to
// vertices further down. Faces of any number of corners are cut into triangles, concave ones too: a
// face of n corners into n - 2, whatever its shape, and so triangles are numbered as faces follow
// each other. What follows x y z (a weight, a colour) is skipped, NaNs too.
//   text       (size) characters, not NULL; they need not end in a NUL or a newline
//   allocator  NULL: malloc and free
//   mesh       not NULL; nsvcd_mesh_free gives it back; left as it was on failure
//   error_line NULL, or set to the line at fault, from 1; 0 where no line is at fault
//   allocates  the mesh, and working memory that is given back; time is linear in size, but for
//              concave faces of thousands of corners: of n corners, n^1.5 in the worst shapes that
//              tests/test_mesh.c tries
//   errors     ARGUMENT, MEMORY, FORMAT (no line is one of OBJ's), SYNTAX, INDEX, NUMBER (of
//              what becomes of it: a coordinate in metres), EMPTY, TOO_LARGE. Of several faults the
//              one that is found first: statements and counts come before vertices, these before
//              faces
//   source     Wavefront, "Object Files", version 3.0; ear clipping after Meisters 1975
NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// nsvcd_obj_parse on what a file holds.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   errors     those of nsvcd_obj_parse, and IO
NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

// Reads STL, binary or text, into a mesh. Corners at the same place become one vertex; normals and
// attributes are skipped.
//   data       (size) bytes, not NULL
//   allocator, mesh, error_line  as above; of what is binary no line is at fault
//   allocates  the mesh, with room for three vertices a triangle, and working memory
//   errors     ARGUMENT, MEMORY, FORMAT (neither text that begins with "solid", nor as long
//              as its count of triangles says), SYNTAX, NUMBER, EMPTY, TOO_LARGE
//   source     3D Systems, "StereoLithography Interface Specification", 1989
NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// nsvcd_stl_parse on what a file holds.
NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

typedef enum nsvcd_mesh_format {
  // STL where it begins with "solid", or has the size that its count of triangles says; else OBJ
  NSVCD_MESH_ANY = 0,
  NSVCD_MESH_OBJ,
  NSVCD_MESH_STL
} nsvcd_mesh_format;

// How the numbers of a file become metres, in double, before they are rounded to float and held
// against NSVCD_MAX_COORDINATE. What is zero is the default.
typedef struct nsvcd_mesh_options {
  nsvcd_mesh_format format;
  // in the file's units: this place becomes the mesh's origin. Of a map, whose coordinates are
  // millions, a place near what is asked about: floats near 5,400,000 are half a metre apart
  double origin[3];
  // then to metres: 0.001 of millimetres; 0: 1
  double scale;
} nsvcd_mesh_options;

// Reads OBJ or STL into a mesh: nsvcd_obj_parse or nsvcd_stl_parse, with options.
//   data       (size) bytes, not NULL
//   options    NULL: by what it is, and the numbers are metres
//   allocator, mesh, error_line  as above
//   errors     those of both, SCALE, and NUMBER for an origin that is not finite
NSVCDDEF nsvcd_result nsvcd_mesh_parse(const void *data, size_t size,
                                       const nsvcd_mesh_options *options,
                                       const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                       size_t *error_line);
#ifndef NSVCD_NO_STDIO
// nsvcd_mesh_parse on what a file holds.
NSVCDDEF nsvcd_result nsvcd_mesh_load(const char *path, const nsvcd_mesh_options *options,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#endif

// Faces of any number of corners: what readers of other formats, and engines, have.
typedef struct nsvcd_faces {
  // (vertex_count, 3) metres
  const float *positions;
  // (corner_count) vertices: those of the first face, counter-clockwise from outside, of the second
  const uint32_t *corners;
  // (face_count), 3 or more each, corner_count in all; NULL: all are triangles
  const uint32_t *sizes;
  size_t vertex_count;
  size_t corner_count;
  size_t face_count;
} nsvcd_faces;

// Cuts faces into triangles, concave ones too, as nsvcd_obj_parse does.
//   faces      not NULL
//   allocator  NULL: malloc and free
//   mesh       not NULL; nsvcd_mesh_free gives it back; left as it was on failure
//   allocates  the mesh, and working memory that is given back; time as of nsvcd_obj_parse
//   errors     ARGUMENT, SIZES, INDEX, NUMBER, EMPTY, TOO_LARGE, MEMORY
NSVCDDEF nsvcd_result nsvcd_mesh_of_faces(const nsvcd_faces *faces,
                                          const nsvcd_allocator *allocator, nsvcd_mesh *mesh);
#endif
#ifndef NSVCD_NO_ENCODER
// Cuts out the part of a mesh within a box: triangles are cut at the box, vertices are not shared.
// For a large mesh that changes all the time, or that the network is to judge, whose patches must
// not be much larger than the gap in question: encode what the moving body can reach, the box over
// its sweep grown a little, as an `open` body. A mesh that stays is better encoded whole, once.
//   mesh       not NULL
//   low, high  the box in the mesh's frame, metres, not NULL, finite, low < high on each axis
//   allocator  NULL: malloc and free
//   part       not NULL; nsvcd_mesh_free gives it back; left as it was on failure
//   allocates  the part
//   errors     ARGUMENT, BOX, EMPTY (nothing of it is in the box), INDEX, NUMBER, TOO_LARGE, MEMORY
//   source     Sutherland and Hodgman 1974
NSVCDDEF nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *mesh, const float low[3],
                                     const float high[3], const nsvcd_allocator *allocator,
                                     nsvcd_mesh *part);
// Gives back what the functions above allocated, and empties *mesh.
//   mesh       may be NULL
//   allocator  the one that it came from
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *allocator);
#endif
