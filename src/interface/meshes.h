// In: an OBJ or STL file; faces, heights or points of the caller. Out: nsvcd_mesh, a part of one.
#pragma once
#include "results.h"

// Triangles. Those that functions here make are freed with nsvcd_mesh_free.
typedef struct nsvcd_mesh {
  // (vertex_count, 3) metres
  float *positions;
  // (triangle_count, 3) vertex numbers from 0, counter-clockwise seen from outside
  uint32_t *indices;
  size_t vertex_count;
  size_t triangle_count;
} nsvcd_mesh;

#ifndef NSVCD_NO_READERS
// Reads OBJ text into a mesh. Only the lines v and f are read; lines end in LF, CR or CR LF. A
// face's corners are v, v/vt, v//vn or v/vt/vn. The number after a slash may be missing, and a
// corner may refer to a vertex further down. Whatever follows x y z (a weight, a colour) is
// skipped, even NaN. Faces of any number of corners are triangulated, concave ones too. A face of n
// corners always makes n - 2 triangles. Triangles are numbered in the order of the faces.
//   text       (size) characters, not NULL; no final NUL or newline is needed
//   allocator  NULL: malloc and free
//   mesh       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   error_line set to the line at fault, from 1, or to 0 if no line is; may be NULL
//   allocates  the mesh, and working memory that is freed again. Time is linear in size, except for
//              concave faces of thousands of corners: n^1.5 for n corners in the worst shapes that
//              tests/test_mesh.c tries
//   errors     ARGUMENT, MEMORY, FORMAT (no line is one of OBJ's), SYNTAX, INDEX, NUMBER (a
//              coordinate in metres), EMPTY, TOO_LARGE. If there are several faults, it is the
//              first one found: statements and counts are checked first, then vertices, then faces
//   source     Wavefront, "Object Files", version 3.0; ear clipping after Meisters 1975
NSVCDDEF nsvcd_result nsvcd_obj_parse(const char *text, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// Reads an OBJ file into a mesh, as nsvcd_obj_parse reads a text.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   allocator, mesh, error_line  as for nsvcd_obj_parse
//   errors     those of nsvcd_obj_parse, and IO
NSVCDDEF nsvcd_result nsvcd_obj_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

// Reads STL, binary or text, into a mesh. Corners at the same position become one vertex; normals
// and attributes are skipped.
//   data       (size) bytes, not NULL
//   allocator, mesh, error_line  as for nsvcd_obj_parse; in a binary file no line is at fault
//   allocates  the mesh, with room for three vertices a triangle, and working memory that is freed
//              again
//   errors     ARGUMENT, MEMORY, FORMAT (it is no text that begins with "solid", nor as long as its
//              count of triangles says), SYNTAX, NUMBER, EMPTY, TOO_LARGE
//   source     3D Systems, "StereoLithography Interface Specification", 1989
NSVCDDEF nsvcd_result nsvcd_stl_parse(const void *data, size_t size,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#ifndef NSVCD_NO_STDIO
// Reads an STL file into a mesh, as nsvcd_stl_parse reads bytes.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   allocator, mesh, error_line  as for nsvcd_stl_parse
//   errors     those of nsvcd_stl_parse, and IO
NSVCDDEF nsvcd_result nsvcd_stl_load(const char *path, const nsvcd_allocator *allocator,
                                     nsvcd_mesh *mesh, size_t *error_line);
#endif

typedef enum nsvcd_mesh_format {
  // STL if it begins with "solid" or is as long as its count of triangles says, else OBJ
  NSVCD_MESH_ANY = 0,
  NSVCD_MESH_OBJ,
  NSVCD_MESH_STL
} nsvcd_mesh_format;

// How a file is read, and how its numbers become metres. That is computed in double. Only then are
// the metres rounded to float, and compared with NSVCD_MAX_COORDINATE. Zero means the default.
typedef struct nsvcd_mesh_options {
  nsvcd_mesh_format format;
  // the point, in the file's units, that becomes the mesh's origin. In a map, whose coordinates are
  // in the millions, choose one near the objects: floats near 5,400,000 are half a metre apart
  double origin[3];
  // metres in one of the file's units: 0.001 for millimetres; default 1
  double scale;
} nsvcd_mesh_options;

// Reads OBJ or STL into a mesh, as nsvcd_obj_parse or nsvcd_stl_parse does, with options.
//   data       (size) bytes, not NULL
//   options    NULL: either format, in metres
//   allocator, mesh, error_line  as for nsvcd_obj_parse; in a binary file no line is at fault
//   allocates  as nsvcd_obj_parse or nsvcd_stl_parse
//   errors     those of nsvcd_obj_parse and nsvcd_stl_parse, SCALE, and NUMBER for an origin that
//              is not finite
NSVCDDEF nsvcd_result nsvcd_mesh_parse(const void *data, size_t size,
                                       const nsvcd_mesh_options *options,
                                       const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                       size_t *error_line);
#ifndef NSVCD_NO_STDIO
// Reads an OBJ or STL file into a mesh, as nsvcd_mesh_parse reads bytes.
//   path       not NULL, as fopen takes it; on Windows in the code page of the process
//   options    NULL: either format, in metres
//   allocator, mesh, error_line  as for nsvcd_mesh_parse
//   errors     those of nsvcd_mesh_parse, and IO
NSVCDDEF nsvcd_result nsvcd_mesh_load(const char *path, const nsvcd_mesh_options *options,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *mesh,
                                      size_t *error_line);
#endif

// Faces of any number of corners, as engines and readers of other formats have them.
typedef struct nsvcd_faces {
  // (vertex_count, 3) metres
  const float *positions;
  // (corner_count) vertex numbers from 0, face after face, counter-clockwise seen from outside
  const uint32_t *corners;
  // (face_count) numbers of corners, 3 or more each, corner_count in all; NULL: all faces are
  // triangles
  const uint32_t *sizes;
  size_t vertex_count;
  size_t corner_count;
  size_t face_count;
} nsvcd_faces;

// Triangulates faces, concave ones too, as nsvcd_obj_parse does.
//   faces      not NULL, not kept
//   allocator  NULL: malloc and free
//   mesh       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   allocates  the mesh, and working memory that is freed again; takes as long as nsvcd_obj_parse
//   errors     ARGUMENT, SIZES, INDEX, NUMBER, EMPTY, TOO_LARGE, MEMORY
//   source     ear clipping after Meisters 1975
NSVCDDEF nsvcd_result nsvcd_mesh_of_faces(const nsvcd_faces *faces,
                                          const nsvcd_allocator *allocator, nsvcd_mesh *mesh);
#endif
#ifndef NSVCD_NO_ENCODER
// Cuts out the part of a mesh that lies in a box. Triangles are cut at the box; vertices are not
// shared. Use it for a large mesh that keeps changing, or for the network, whose patches must not
// be much larger than the gap in question. Encode the part that the moving body can reach (the box
// of its sweep, grown a little) as an `open` body. A mesh that does not change is better encoded
// whole, once.
//   mesh       not NULL
//   low, high  the box in the mesh's frame, metres, not NULL, finite, low < high on each axis
//   allocator  NULL: malloc and free
//   part       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   allocates  the part
//   errors     ARGUMENT, BOX, EMPTY (nothing is in the box), INDEX, NUMBER, TOO_LARGE, MEMORY
//   source     Sutherland and Hodgman 1974
NSVCDDEF nsvcd_result nsvcd_mesh_cut(const nsvcd_mesh *mesh, const float low[3],
                                     const float high[3], const nsvcd_allocator *allocator,
                                     nsvcd_mesh *part);
// Makes the convex hull of points: a closed mesh. Its vertices are those points that are corners of
// the hull, unchanged. Points may repeat, lie in one plane with many others, or be as near to each
// other as floats can be. A game often takes the hull of a prop in place of its mesh: it has fewer
// triangles and no flaws.
//
// The hull is computed exactly for points on a grid: along each axis a point is moved by less than
// 1e-9 of the side of the box of all. No point is farther outside of the mesh than 2e-9 of the
// sides. 100,000 points take 9 to 158 ms (tests/test_shapes.c).
//   points     (count, 3) metres, not NULL, not kept
//   allocator  NULL: malloc and free
//   hull       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   allocates  the mesh, and working memory that is freed again: 24 bytes a point, and up to 400 a
//              corner
//   errors     ARGUMENT, TOO_LARGE, NUMBER, EMPTY (all are in one plane, so that they enclose
//              nothing: give it a thickness, each point twice), MEMORY
//   source     Barber, Dobkin and Huhdanpaa 1996, "The Quickhull algorithm for convex hulls"
NSVCDDEF nsvcd_result nsvcd_mesh_hull(const float *points, size_t count,
                                      const nsvcd_allocator *allocator, nsvcd_mesh *hull);

// Makes a mesh of a height field: a terrain, or an elevation map. The sample of a row and a column
// is the vertex (column * step[0], row * step[1], height), z up. A cell of four samples is two
// triangles, which meet along the diagonal from its sample of the least row and column. A cell that
// lacks one sample is one triangle, and one that lacks more is a hole. Encode the mesh as `open`.
//
// Keep a field that changes in chunks that share their outer samples, each a body with a pose, and
// encode only those anew that changed.
//   heights    (rows, columns) metres, not NULL, not kept; NaN: there is no sample
//   step       (2) metres along x and along y between samples, not NULL, > 0
//   allocator  NULL: malloc and free
//   mesh       not NULL; free it with nsvcd_mesh_free; left as it was on failure
//   allocates  the mesh
//   errors     ARGUMENT, SCALE (`step`), EMPTY (there is no triangle), TOO_LARGE, NUMBER, MEMORY
//   source     this library
NSVCDDEF nsvcd_result nsvcd_mesh_of_heights(const float *heights, size_t rows, size_t columns,
                                            const float step[2],
                                            const nsvcd_allocator *allocator,
                                            nsvcd_mesh *mesh);

// Frees a mesh that a function here allocated, and empties *mesh.
//   mesh       may be NULL
//   allocator  the one that the mesh came from
NSVCDDEF void nsvcd_mesh_free(nsvcd_mesh *mesh, const nsvcd_allocator *allocator);
#endif
