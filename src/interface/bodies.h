// In: a mesh, or bytes that were a body. Out: nsvcd_body, and facts about it.
//
// CLOSED MESHES
//   Only a closed component of a mesh has an inside. A component is closed if every edge has its
//   reverse, whichever way it is wound as a whole. Some flaws are set aside, since they do no harm
//   to that: faces that occur twice or turned round, fins, inner walls, slivers, and small gaps
//   between corners. A gap is small if it is at most a ten-thousandth of the diagonal of the mesh's
//   box, and at most a hundredth of the longest edge at either corner. (What is thinner than such a
//   gap may slip through it.) A component that is still open encloses nothing for certain.
//   nsvcd_body_facts counts these components.
//
//   An open component with small holes is nearly a solid. Its surface goes on across each hole, as
//   it does not at the rim of a bin, a tube or a floor. Its holes are small if each is a slit or a
//   single triangle, and together they are less than half of the area. They are also small if they
//   are less than a fiftieth of the area, and the component is wound outwards. If something seems
//   to be inside a component that is nearly a solid, a question is UNDECIDED, unless the mesh was
//   encoded as `open`.
#pragma once
#include "meshes.h"

// An encoded body: one relocatable blob without pointers, aligned to NSVCD_ALIGNMENT. Copy it with
// memcpy, write it with fwrite, map it, or bake it into flash as a const array. Its size is
// nsvcd_body_facts.size. Threads may share it. Functions that take a body check its first bytes
// (errors BODY, VERSION) and trust the rest.
//
// Floats are IEEE 754, and everything is in the byte order of the machine that encoded the body.
// The blob begins with "NSVB" on a little-endian machine and with "BVSN" on a big-endian one.
// Machines of the other order refuse it.
typedef struct nsvcd_body nsvcd_body;

#define NSVCD_ALIGNMENT 8
// The default number of patches of most bodies with triangles, and of a body for the network alone,
// which needs finer patches than a proof.
#define NSVCD_DEFAULT_PATCHES 192
#define NSVCD_DEFAULT_NETWORK_PATCHES 256
#define NSVCD_MAX_PATCHES 65536
// A body of more patches is a level: its patches are in a tree.
#define NSVCD_SMALL_PATCHES 512
// By default, a mesh of up to NSVCD_VERY_FEW_TRIANGLES has one patch for each triangle, but at
// least NSVCD_LEAST_PATCHES. A mesh of up to NSVCD_MANY_TRIANGLES has one patch for every
// NSVCD_PATCH_TRIANGLES triangles, but at least NSVCD_DEFAULT_PATCHES and at most
// NSVCD_SMALL_PATCHES. A larger mesh is a level, with one patch for every NSVCD_LEVEL_TRIANGLES.
#define NSVCD_LEAST_PATCHES 12
#define NSVCD_VERY_FEW_TRIANGLES 48
#define NSVCD_PATCH_TRIANGLES 50
#define NSVCD_MANY_TRIANGLES 131072
#define NSVCD_LEVEL_TRIANGLES 12
// the most balls of a body
#define NSVCD_MAX_BALLS 1024
// metres: the largest coordinate of a vertex or a position
#define NSVCD_MAX_COORDINATE 1e6f
// metres: the smallest radius of a body's bounding sphere
#define NSVCD_MIN_RADIUS 1e-12f
// the most poses of a body in a question
#define NSVCD_MAX_POSES 65536
// the scales that a body may have in a question
#define NSVCD_MIN_SCALE 1e-6f
#define NSVCD_MAX_SCALE 1e6f

// A function that is called now and then with the fraction done, in [0,1]. It returns 0 to go on;
// anything else ends the work with NSVCD_ERROR_CANCELLED.
typedef int nsvcd_progress(float done, void *user);

// How a mesh is encoded. Zero means the default.
typedef struct nsvcd_encode_options {
  // N, the number of patches, 1..NSVCD_MAX_PATCHES; default by patch_radius, if that is set, or
  // else by the number of triangles, as above
  size_t patches;
  // metres: the mesh gets as many patches as give each about this radius, if `patches` is 0. For a
  // level, take half the size of the bodies that move in it
  float patch_radius;
  // metres: the body is everything within this distance of the mesh. If it is not 0, triangles need
  // no area: one vertex three times makes a ball, two vertices make a capsule. A body with a convex
  // radius has no latents
  float convex_radius;
  // 1: the mesh is not closed (a sheet, or a part cut out), and nothing is inside it. 0: if
  // something seems to be inside a component that is nearly a solid, a question is undecided; see
  // CLOSED MESHES
  int open;
  // 1: the network can answer as well. The proof needs no latents, which take 93 bytes a patch, and
  // time to encode
  int latents;
  // 1: only the network can answer. The body takes fewer bytes, and there is no proof
  int no_triangles;
  // 1: the proof's triangles are stored with 16 bits a coordinate, for scarce flash. That takes
  // about 5 % fewer bytes, 10 to 40 % fewer for a fine mesh. Verdicts are then about these
  // triangles, which are within nsvcd_body_facts.quantization_error of the mesh's own: a HIT says
  // that the mesh comes that near
  int coarse;
  // The most balls that cover the mesh, for looks (nsvcd_look) and routes, up to NSVCD_MAX_BALLS.
  // 128 suit a robot's link: they take 2 KB, and about 0.1 s to find. 0: none. A cloud has none
  size_t balls;
  // called with the fraction done; may be NULL
  nsvcd_progress *progress;
  // passed to `progress`
  void *user;
} nsvcd_encode_options;

#ifndef NSVCD_NO_NETWORK
// Bytes of a body without triangles; 0 if there can be no such body. A body with triangles is
// larger: let nsvcd_encode allocate it.
//   patches    1..NSVCD_MAX_PATCHES
NSVCDDEF size_t nsvcd_body_size(size_t patches);
// nsvcd_body_size as a constant, for 1 to NSVCD_SMALL_PATCHES patches.
#define NSVCD_BODY_BYTES(patches) \
  ((64 + 52 * (((patches) + 15) / 16 * 16) + 16 * ((((patches) + 15) / 16 + 15) / 16 * 16) + \
    40 * (patches) + 7) / \
   8 * 8)
#endif

#ifndef NSVCD_NO_ENCODER
// Encodes a mesh into a body. It may have fewer patches than asked for, if the surface has too few
// distinct points. The same mesh gives the same bytes, in one build: see DETERMINISM below.
//   mesh       not NULL; not kept
//   options    NULL: the defaults, for the proof
//   allocator  NULL: malloc and free
//   memory     (capacity) bytes, aligned to NSVCD_ALIGNMENT, for the body. NULL: the body comes
//              from the allocator; free it with nsvcd_body_free
//   body       not NULL; set to the body, or left as it was on failure
//   allocates  working memory, which is freed again, and the body if memory is NULL
//   errors     ARGUMENT, PATCHES, RADIUS (`convex_radius`), COUNT (`balls`), TRIANGLES (`balls`
//              with `no_triangles`), LATENTS, INDEX, NUMBER, EMPTY, TOO_LARGE, MEMORY, WORKSPACE,
//              CANCELLED
//   source     the latents: NeuralSVCD, appendix F; the triangles: this library
NSVCDDEF nsvcd_result nsvcd_encode(const nsvcd_mesh *mesh, const nsvcd_encode_options *options,
                                   const nsvcd_allocator *allocator, void *memory,
                                   size_t capacity, const nsvcd_body **body);
#ifndef NSVCD_NO_PROOF
// Encode bodies of simple shapes, for the proof: a sphere, a capsule, a box, a cloud of spheres.
// They are exact but for rounding to float. Each is what nsvcd_encode makes of a point, a segment,
// a box or points with options.convex_radius. They are faster to query than meshes of many
// triangles: a capsule is a single segment.
//
// A cloud may be a map of voxels, of which it has the centres. With a radius of 0.8661 edges it
// contains the cubes; with half an edge it lies within them. Only a mesh of their faces is exact.
// Keep a map that changes in chunks of about 16 x 16 x 16 cells, each a body. Encode only those
// anew that changed, and ask about all that are near with nsvcd_sweep_batch.
//   radius, convex_radius  metres, > 0; a box's may be 0
//   from, to        the ends of the capsule's axis, not NULL, metres; may be the same
//   half            half the box's lengths, including convex_radius and no less than it; (3)
//                   metres, not NULL
//   points          (count, 3) centres of the spheres, metres, not NULL, not kept
//   allocator       NULL: malloc and free
//   body            not NULL; set to the body, or left as it was on failure. Free it with
//                   nsvcd_body_free. A sphere and a box are centred at the origin; a capsule and
//                   a cloud lie where their ends and points do
//   allocates       the body, and working memory, which is freed again
//   errors          ARGUMENT, RADIUS, NUMBER, EMPTY, TOO_LARGE, MEMORY
//   source          this library
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
// Frees a body that nsvcd_encode or one of the shapes allocated.
//   body       may be NULL; what does not begin as a body does is left alone
//   allocator  the one that the body came from
NSVCDDEF void nsvcd_body_free(const nsvcd_body *body, const nsvcd_allocator *allocator);
#endif

// Takes untrusted bytes for a body, after checking every one of them.
//   memory     (size) bytes, not NULL, aligned to NSVCD_ALIGNMENT; the body stays in it
//   body       not NULL; set to the body, or left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT (NULL), VERSION (the body has another version, other weights or the other
//              byte order), BODY (anything else is wrong)
NSVCDDEF nsvcd_result nsvcd_body_load(const void *memory, size_t size,
                                      const nsvcd_body **body);

// Takes bytes for a body that are known to be as nsvcd_encode made them. Only the header is
// checked: version, weights and size. Use it for an array baked into the program, or for a large
// mapped file that was loaded once before, whose pages are then read as queries need them. Bytes
// that have changed since do harm: answers are wrong, or reads go out of bounds.
//   memory     (size) bytes, not NULL, aligned to NSVCD_ALIGNMENT; the body stays in it
//   body       not NULL; set to the body, or left as it was on failure
//   allocates  nothing
//   errors     those of nsvcd_body_load
NSVCDDEF nsvcd_result nsvcd_body_trust(const void *memory, size_t size,
                                       const nsvcd_body **body);

// Writes a copy of a body, scaled about its origin by a factor for each axis: for a prop that is
// placed in several sizes, for a planner, or to bake it. A question needs no copy of one that is
// scaled as a whole, since a mover has a scale. Latents do not depend on such a scale, and answers
// scale along, up to rounding.
//
// Factors that differ stretch, and an odd number of negative ones mirrors, the mesh: verdicts are
// about its vertices, each coordinate times its factor, rounded to float. Which components are
// closed does not change. Latents are left out. Balls grow, and with them ball_error, so for looks
// encode the stretched mesh; so too if factors differ a hundredfold, since then patches are long,
// and questions take longer. A body with a convex radius would not be round any more, and is
// refused.
//   body       not NULL
//   scale      (3) not NULL, not 0; all the same and > 0: as a whole
//   memory     (capacity) bytes, as many as the body has or more, not NULL, aligned to
//              NSVCD_ALIGNMENT; may be the body's own
//   scaled     not NULL; set to the copy, or left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, BODY, VERSION, SCALE (also if the copy would be smaller or larger than a
//              body may be, or if factors differ for a body with a convex radius), WORKSPACE,
//              TRIANGLES (factors differ and the body has none; or with NSVCD_NO_PROOF, which
//              cannot scale them)
NSVCDDEF nsvcd_result nsvcd_body_scale(const nsvcd_body *body, const float scale[3],
                                       void *memory, size_t capacity,
                                       const nsvcd_body **scaled);

// What a body is. The mesh is the one that it was encoded from, in the body's frame.
typedef struct nsvcd_body_facts {
  // bytes of the body
  size_t size;
  // N, the number of patches
  size_t patches;
  // metres: a sphere that contains the body
  float centre[3];
  float radius;
  // metres: no point of the mesh is farther from the body's origin
  float extent;
  // metres: a box that contains the mesh; 0 if no triangles are stored
  float low[3], high[3];
  // metres
  float mean_patch_radius;
  // number of the mesh's triangles; 0: none are stored
  size_t triangles;
  // number of entries, which are triangles, and parts of them, patch by patch
  size_t stored_triangles;
  // metres: the triangles that verdicts are about are within this of the mesh's. 0: they are the
  // mesh's own floats. Otherwise the body is coarse, or nsvcd_body_scale has rounded it
  float quantization_error;
  // metres by which the body exceeds its mesh
  float convex_radius;
  // number of balls that cover the mesh; 0: none are stored
  size_t balls;
  // metres: no point of a ball is farther than this from the body: from its surface, or what it
  // encloses if it is closed
  float ball_error;
  // 1: the network can answer
  int latents;
  // number of the mesh's components, and of those among them that are open (see CLOSED MESHES);
  // both are 0 if no triangles are stored. No open ones: all of the mesh is solid
  size_t components, open_components;
  // number of edges of the open components that have an odd number of triangles, mostly one
  size_t open_edges;
  // 1: the mesh was encoded as `open`
  int open;
} nsvcd_body_facts;

// Describes a body. If it is none, all facts are 0.
//   body       may be NULL
NSVCDDEF nsvcd_body_facts nsvcd_body_describe(const nsvcd_body *body);

// Writes the sphere of one patch. Returns 1; or 0, writing nothing, if there is no such patch or
// body.
//   body       may be NULL
//   patch      a number, as nsvcd_answer has it
//   centre     not NULL, metres, body frame
//   radius     not NULL, metres
NSVCDDEF int nsvcd_body_patch(const nsvcd_body *body, uint32_t patch, float centre[3],
                              float *radius);
