// In: a question, and its two meshes. Out: bytes that prove the answer. Anyone who has the meshes
// can check them with examples/verify, which shares nothing with this library.
#pragma once
#include "queries.h"

// A tree of boxes over the triangles of a mesh, in the caller's memory, for nsvcd_certify. It keeps
// pointers to the mesh's arrays, which must not change. Threads may share it.
typedef struct nsvcd_tree nsvcd_tree;

// Bytes that nsvcd_tree_build needs, about 88 for a triangle and 9 for a vertex; 0 if the mesh is
// refused.
//   mesh       may be NULL
NSVCDDEF size_t nsvcd_tree_size(const nsvcd_mesh *mesh);

// Builds the tree of a mesh, which takes about as long as sorting its triangles.
//   mesh       not NULL; its arrays are kept
//   memory     (size) bytes, nsvcd_tree_size(mesh) or more, not NULL, aligned to NSVCD_ALIGNMENT;
//              the tree is in it
//   tree       not NULL; set to the tree, or left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, INDEX, NUMBER, EMPTY, TOO_LARGE, WORKSPACE
NSVCDDEF nsvcd_result nsvcd_tree_build(const nsvcd_mesh *mesh, void *memory, size_t size,
                                       const nsvcd_tree **tree);

// A pose in double. A corner x of the mesh is at position + scale * x turned by `rotation`.
typedef struct nsvcd_pose64 {
  double position[3];  // metres
  double rotation[4];  // quaternion x y z w, of any length but 0
} nsvcd_pose64;

// A bound of how far a point leaves the chord between its positions at two times, in metres along a
// unit direction n: base + per_metre r + turn rho |n x R axis|. The point is r metres from the
// mesh's origin, and rho metres from the line through the origin along the axis.
typedef struct nsvcd_deviation {
  double base, per_metre, turn;
  // a unit vector of the mesh's frame that the rotation R takes to the same vector at all times in
  // between; or 0, with `turn` 0
  double axis[3];
} nsvcd_deviation;

// How a mesh moves, for nsvcd_certify_models, with t in [0,1]. A keyframe is a time at which the
// motion may have a corner. The proof relies on what the functions return.
typedef struct nsvcd_motion_model {
  // scale of the mesh about its origin
  double scale;
  // the pose at a time
  nsvcd_pose64 (*pose_at)(const void *motion, double t);
  // the next keyframe after a time before 1
  double (*next)(const void *motion, double t);
  // the deviation of the mesh's points from t0 to t1, between which there is no keyframe
  nsvcd_deviation (*deviation)(const void *motion, double t0, double t1);
  const void *motion;  // handed to these functions
  double extent;       // metres: a bound of the lengths that its positions are computed from
  uint32_t digest;     // digest of the scale and the motion, as a checker computes it
} nsvcd_motion_model;

#define NSVCD_DEFAULT_VISITS 1000000

// How an answer is certified. Zero means the default.
typedef struct nsvcd_certify_options {
  // the answer of nsvcd_sweep, as a hint where a hit is; may be NULL. One thing is believed of it:
  // if it says that something is, or may be, inside a mesh that is not closed, no certificate says
  // FREE
  const nsvcd_answer *answer;
  // the most visits of the traversal, each to two boxes over an interval of time; default
  // NSVCD_DEFAULT_VISITS
  size_t visits;
} nsvcd_certify_options;

// What was proven.
typedef struct nsvcd_certificate {
  // FREE and HIT: the bytes prove it. UNDECIDED: there are no bytes
  nsvcd_verdict verdict;
  // the reason if it is UNDECIDED. WORK: the visits were not enough. TOO_NEAR: surfaces touch, or
  // come too near to tell; or none of 64 rays was clear. OPEN: options.answer says that something
  // is, or may be, inside a mesh that is not closed. Closed is meant as examples/verify has it:
  // each edge must have its reverse, and no flaw is mended
  nsvcd_why why;
  // 1: a HIT because a corner of one mesh is inside the other
  int inside;
  // time in [0,1] of the contact that is proven, of a HIT; it need not be the first
  double time;
  // bytes of the certificate, also if there was no room for all
  size_t size;
  // number of visits that the traversal took
  size_t visits;
} nsvcd_certificate;

// Bytes of workspace that nsvcd_certify needs: some 300 for each pose of either mesh, and 4 for
// each vertex of the mesh that has more; 0 if the question is refused.
//   question   not NULL
//   a, b       trees of the meshes of question->a and question->b, not NULL
NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b);

// Proves the answer to a question anew, and writes the proof. It shares two things with
// nsvcd_sweep, both of which are checked: where a body is between two poses, and how the nearest
// points of two triangles are found.
//
// FREE: the two surfaces never come within the clearance, and neither mesh is inside the other.
// HIT: at the certificate's time an edge passes through a triangle, or points are nearer than the
// clearance, or a corner is inside. Surfaces are UNDECIDED as well if they only touch, with no edge
// through a triangle, or come nearer than 1e-10 of all lengths (extents, and positions in the
// world).
//   question   not NULL. Its poses, times, scales and clearance are used; its bodies are not, and
//              may be NULL
//   a, b       trees of the meshes of question->a and question->b, not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_certify_workspace_size(question, a, b) or more, not
//              NULL, aligned to NSVCD_ALIGNMENT
//   bytes      (capacity): the certificate, as far as there is room; NULL if capacity is 0. Free
//              motions take 40 to 300 bytes in the median, 2,000 in the mean and 90,000 at most
//   made       not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a workspace of its own; trees may be shared
//   errors     ARGUMENT, SLOP and PIVOT (if there is one), SCALE, POSES, TIMES, POSE, QUATERNION,
//              CLEARANCE, WORKSPACE
//   source     this library; examples/verify/nsvcd_verify.h describes the traversal. Planes by
//              Gilbert 1966
NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made);

// Bytes of workspace that nsvcd_certify_models needs; 0 if they are more than SIZE_MAX.
//   keyframes  number of keyframes of both models, with 0 and 1
//   a, b       trees of the meshes, not NULL
NSVCDDEF size_t nsvcd_certify_models_workspace_size(size_t keyframes, const nsvcd_tree *a,
                                                    const nsvcd_tree *b);

// Proves whether two meshes meet in any two motions, and writes the proof, as nsvcd_certify does.
// neuralsvcd_robot.h has the motions of a robot's joints: nsvcd_certify_pair.
//   models     (2) motions of the meshes of a and b, not NULL
//   keyframes  number of keyframes of both models, with 0 and 1. If there are more, the answer is
//              UNDECIDED
//   clearance  metres
//   a, b, options, bytes, made   as for nsvcd_certify
//   workspace  (workspace_size) bytes, nsvcd_certify_models_workspace_size(keyframes, a, b) or
//              more, not NULL, aligned to NSVCD_ALIGNMENT
//   allocates  nothing
//   threads    each needs a workspace of its own; trees may be shared
//   errors     ARGUMENT, CLEARANCE, WORKSPACE
//   source     this library
NSVCDDEF nsvcd_result nsvcd_certify_models(
    const nsvcd_motion_model *models, size_t keyframes, float clearance, const nsvcd_tree *a,
    const nsvcd_tree *b, const nsvcd_certify_options *options, void *workspace,
    size_t workspace_size, uint8_t *bytes, size_t capacity, nsvcd_certificate *made);
