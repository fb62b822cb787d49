// In: a mesh, or bytes that were a body. Out: nsvcd_body, and facts about it.
#pragma once
#include "meshes.h"

// An encoded body: one relocatable blob without pointers, aligned to NSVCD_ALIGNMENT. Copy it with
// memcpy, write it with fwrite, map it, or bake it into flash as a const array. IEEE 754, in the
// byte order of the machine that encoded it, and refused by one of the other order: it begins with
// "NSVB" where that is little-endian, with "BVSN" where it is big-endian. nsvcd_body_facts.size is
// its size. Threads may share it. Whatever takes one looks at its first bytes, and says BODY or
// VERSION of what is none; it trusts the rest.
typedef struct nsvcd_body nsvcd_body;

#define NSVCD_ALIGNMENT 8
// Patches of a body, where the options do not say: of one with triangles, and of one for the
// network alone, which needs finer patches than a proof.
#define NSVCD_DEFAULT_PATCHES 192
#define NSVCD_DEFAULT_NETWORK_PATCHES 256
#define NSVCD_MAX_PATCHES 65536
// A body of more patches is a level: its patches are in a tree.
#define NSVCD_SMALL_PATCHES 512
// Where the options do not say, a mesh of up to VERY_FEW triangles has a patch for each, but no
// fewer than LEAST; of up to MANY, a patch for each NSVCD_PATCH_TRIANGLES, but no fewer than
// NSVCD_DEFAULT_PATCHES and no more than NSVCD_SMALL_PATCHES. A mesh of more is a level, with a
// patch for each 12 triangles.
#define NSVCD_LEAST_PATCHES 12
#define NSVCD_VERY_FEW_TRIANGLES 48
#define NSVCD_PATCH_TRIANGLES 50
#define NSVCD_MANY_TRIANGLES 131072
#define NSVCD_LEVEL_TRIANGLES 12
// metres
#define NSVCD_MAX_COORDINATE 1e6f
// metres, of the sphere about a body
#define NSVCD_MIN_RADIUS 1e-12f
// per motion
#define NSVCD_MAX_POSES 65536
// of a body in a question
#define NSVCD_MIN_SCALE 1e-6f
#define NSVCD_MAX_SCALE 1e6f

// Told now and then how much is done, in [0,1]. Returns 0 to go on; otherwise the work is given up,
// and the result is NSVCD_ERROR_CANCELLED.
typedef int nsvcd_progress(float done, void *user);

// What is zero is the default.
typedef struct nsvcd_encode_options {
  // N, 1..NSVCD_MAX_PATCHES; 0: by the number of triangles, see above
  size_t patches;
  // metres; if > 0 and patches is 0: as many patches as have about this radius. For a level about
  // half the size of the bodies that move in it
  float patch_radius;
  // metres: the body is all that is no farther from the mesh than this. If > 0, triangles need no
  // area: one of the same vertex thrice is a ball, one of two vertices a capsule. Such a body has
  // no latents
  float convex_radius;
  // 1: the mesh is not closed (a sheet, or a part cut out): nothing counts as inside it. Where it
  // is not said, a part that is nearly a solid leaves undecided what seems to be inside of it: its
  // surface goes on across each of its holes, as it does not at the rim of a bin, a tube or a
  // floor; each is a slit, or a single triangle, and these are less than half of its area; or it is
  // wound outwards, and all holes are less than a fiftieth
  int open;
  // 1: for the network too, of which the proof needs nothing: 93 bytes more a patch, and time
  int latents;
  // 1: for the network alone, in fewer bytes; then there is no proof
  int no_triangles;
  // 1: for flash that is scarce: the proof's triangles in 16 bits a coordinate, in some 5 % fewer
  // bytes, 10 to 40 % of a fine mesh. Verdicts are then about these, which are within
  // nsvcd_body_facts.quantization error of the mesh's own: HIT says that the mesh comes as near as
  // that
  int coarse;
  // NULL, or told how much is done
  nsvcd_progress *progress;
  // handed to progress
  void *user;
} nsvcd_encode_options;

#ifndef NSVCD_NO_NETWORK
// Bytes of a body without triangles; 0 if there can be no such body. One with triangles is larger:
// let nsvcd_encode allocate it.
NSVCDDEF size_t nsvcd_body_size(size_t patches);
// The same as a constant, for 1 to NSVCD_SMALL_PATCHES patches.
#define NSVCD_BODY_BYTES(patches) \
  ((64 + 52 * (((patches) + 15) / 16 * 16) + 16 * ((((patches) + 15) / 16 + 15) / 16 * 16) + \
    40 * (patches) + 7) / \
   8 * 8)
#endif

#ifndef NSVCD_NO_ENCODER
// Encodes a mesh into a body. The body may have fewer patches than asked, where the surface has too
// few points to tell apart. Same mesh, same bytes, in one build: see DETERMINISM above.
//   mesh       not NULL; not kept
//   options    NULL: the defaults, for the proof
//   allocator  NULL: malloc and free
//   memory     (capacity) bytes, aligned to NSVCD_ALIGNMENT, for the body. NULL: the body comes
//              from the allocator, and nsvcd_body_free gives it back
//   body       not NULL; set to the body; left as it was on failure
//   allocates  working memory, which is given back, and the body where memory is NULL
//   errors     ARGUMENT, PATCHES, RADIUS (`convex_radius`), LATENTS, INDEX, NUMBER, EMPTY,
//              TOO_LARGE, MEMORY, WORKSPACE, CANCELLED
//   source     the latents: NeuralSVCD, appendix F; the triangles: this library
NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *allocator, void *memory,
                                   size_t capacity, const nsvcd_body **body);
#ifndef NSVCD_NO_PROOF
// Bodies of a shape, for the proof, exact but for the roundings of float: what nsvcd_encode makes
// of a point, a segment, a box or points and options.round. Where time matters they are better than
// meshes of many triangles: a capsule is one segment. Voxels are a cloud of their centres: with a
// radius of 0.8661 edges it contains the cubes, with half an edge it is within them; exact are only
// their faces, as a mesh. A map that changes is best kept in chunks of some 16 x 16 x 16 cells, a
// body each, of which only those with changes are encoded anew; nsvcd_sweep_batch asks all that are
// near.
//   radius, round   metres, > 0; that of a box may be 0
//   from, to        the ends of the capsule's axis, not NULL, metres; may be the same
//   half            half-extents including the rounding radius; each >= round; not NULL, metres
//   points          (count, 3) metres, not NULL, not kept
//   allocator       NULL: malloc and free
//   body            not NULL; set to the body, about the origin or where its ends and points are;
//                   left as it was on failure; nsvcd_body_free gives it back
//   allocates       the body, and working memory, which is given back
//   errors          ARGUMENT, RADIUS, NUMBER, EMPTY, TOO_LARGE, MEMORY
NSVCDDEF nsvcd_result nsvcd_encode_sphere(float radius, const nsvcd_allocator *allocator,
                                          const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_capsule(const float from[3], const float to[3],
                                           float radius, const nsvcd_allocator *allocator,
                                           const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_box(const float half[3], float convex_radius,
                                       const nsvcd_allocator *allocator,
                                       const nsvcd_body **body);
NSVCDDEF nsvcd_result nsvcd_encode_cloud(const float *points, size_t count, float radius,
                                         const nsvcd_allocator *allocator,
                                         const nsvcd_body **body);
#endif
// Gives back a body that nsvcd_encode allocated.
//   body       may be NULL; what does not begin as a body does is left alone
//   allocator  the one that it came from
NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *allocator);
#endif

// Checks a blob that nobody vouches for, every byte of it, and takes it for a body.
//   memory     (size) bytes, not NULL, aligned to NSVCD_ALIGNMENT; the body stays in it
//   body       not NULL; set to the body; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (NULL), VERSION (it is a body, but of another version, other weights or the
//              other byte order), BODY (anything else is wrong with it)
NSVCDDEF nsvcd_result nsvcd_body_load(const void *memory, size_t size,
                                      const nsvcd_body **body);

// nsvcd_body_load for bytes that are known to be what nsvcd_encode made. Only the header is read:
// is it a body of this version and these weights, and is all of it there? For an array baked into
// the program, and for a large mapped file that was loaded once before: its pages are then read as
// queries need them. Bytes that were changed since do harm: wrong answers, or reads anywhere.
// Arguments and errors are those of nsvcd_body_load.
NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body);

// Writes a copy of a body, scaled about its origin: for a planner's bodies, or to bake one; a
// question has scales of its own. Latents do not depend on scale, and answers scale along, to
// rounding.
//   body       not NULL
//   scale      > 0
//   memory     (capacity) bytes, not NULL, aligned to NSVCD_ALIGNMENT; may be where the body is
//   scaled     not NULL; set to the copy; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, BODY, VERSION, SCALE (also if the copy were smaller or larger than a body
//              may be), WORKSPACE; with NSVCD_NO_PROOF also TRIANGLES: it has some, which that
//              cannot scale
NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, float scale, void *memory,
                                       size_t capacity, const nsvcd_body **scaled);

typedef struct nsvcd_body_facts {
  // bytes: what to save
  size_t size;
  // N
  size_t patches;
  // metres: a sphere that contains the body
  float centre[3];
  float radius;
  // metres: no point of the mesh is farther from the origin
  float extent;
  // metres: a box that contains the mesh; 0 where no triangles are stored
  float low[3], high[3];
  // metres
  float mean_patch_radius;
  // of the mesh; 0: none are stored
  size_t triangles;
  // triangles and parts of them that are stored, patch by patch
  size_t stored_triangles;
  // metres: the triangles that verdicts are about are within this of the mesh's. 0: they are the
  // mesh's own floats. Else the body is coarse, or nsvcd_body_scale has rounded it
  float quantization_error;
  // metres that the body goes beyond its mesh
  float convex_radius;
  // 1: the network can answer
  int latents;
  // parts of the surface, and how many of these are not closed once what does no harm is mended
  // (see WHAT AN ANSWER IS WORTH): 0: all is a solid. 0, 0 where no triangles are stored
  size_t components, open_components;
  // of these: edges of a single triangle, or of another odd number
  size_t open_edges;
  // 1: it was said to be open
  int open;
} nsvcd_body_facts;

// What a body is; all 0 where it is none.
//   body       may be NULL
NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body);

// The sphere of one patch. Returns 1, or, if there is no such patch or no body, 0: then nothing is
// written.
//   patch      as in nsvcd_answer
//   centre     not NULL, metres, body frame
//   radius     not NULL, metres
NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius);
