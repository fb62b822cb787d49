// In: a question, and its two meshes. Out: bytes that prove the answer to anyone who has the meshes
// and examples/verify, which shares nothing with this library.
#pragma once
#include "queries.h"

// A tree of boxes over the triangles of a mesh, in the caller's memory, for nsvcd_certify. It keeps
// pointers to the mesh's arrays, which must not change; threads may share it.
typedef struct nsvcd_tree nsvcd_tree;

// Bytes that nsvcd_tree_build needs; 0 if the mesh is refused. About 88 for a triangle and 9 for a
// vertex.
NSVCDDEF size_t nsvcd_tree_size(const nsvcd_mesh *mesh);

// Builds the tree of a mesh, which takes about as long as sorting its triangles.
//   mesh       not NULL
//   memory     (size) bytes, nsvcd_tree_size(mesh) or more, not NULL, aligned to NSVCD_ALIGNMENT
//   tree       not NULL; left as it was on failure
//   allocates  nothing
//   errors     ARGUMENT, INDEX, NUMBER, EMPTY, TOO_LARGE, WORKSPACE
NSVCDDEF nsvcd_result nsvcd_tree_build(const nsvcd_mesh *mesh, void *memory, size_t size,
                                       const nsvcd_tree **tree);

// A pose in double: takes a corner x of the mesh to position + scale * x turned by rotation.
typedef struct nsvcd_pose64 {
  double position[3];  // metres
  double rotation[4];  // x y z w, of any length but 0
} nsvcd_pose64;

// A bound of how far a point leaves the chord between its positions at two times, along a unit
// direction n: base + per_metre r + turn rho |n x R axis|. The point is r metres from the mesh's
// origin, and rho from the line through the origin along the axis. The axis is a unit vector of the
// mesh that the rotation R takes to the same vector at all these times, or 0.
typedef struct nsvcd_deviation {
  double base, per_metre, turn;
  double axis[3];
} nsvcd_deviation;

// How a mesh moves, for nsvcd_certify_models: t in [0,1]. A keyframe is a time at which the motion
// may have a corner; the deviation is asked for between two of them. The proof relies on it.
typedef struct nsvcd_motion_model {
  double scale;
  nsvcd_pose64 (*pose_at)(const void *motion, double t);
  // the next keyframe after a time before 1
  double (*next)(const void *motion, double t);
  nsvcd_deviation (*deviation)(const void *motion, double t0, double t1);
  const void *motion;  // handed to these
  double extent;       // metres: a bound of the lengths that its positions are computed from
  uint32_t digest;     // of the scale and the motion, as a checker computes it
} nsvcd_motion_model;

#define NSVCD_DEFAULT_VISITS 1000000

// Zero means the default.
typedef struct nsvcd_certify_options {
  // NULL, or the answer of nsvcd_sweep: a hint where a hit is. Only one thing is believed of it:
  // that something is, or may be, inside of a mesh that is not closed. Then no certificate says
  // FREE
  const nsvcd_answer *answer;
  // of the traversal, at most; 0: NSVCD_DEFAULT_VISITS
  size_t visits;
} nsvcd_certify_options;

typedef struct nsvcd_certificate {
  // FREE or HIT: the bytes prove it. UNDECIDED: there are none
  nsvcd_verdict verdict;
  // of UNDECIDED: too few visits; surfaces that touch, or come too near to tell; of 64 rays none
  // was clear; or the answer says that something is inside of a mesh that is not closed. That is
  // meant as examples/verify has it: each edge must have its reverse, and no flaw is mended
  nsvcd_why why;
  // 1: a HIT because a corner of one is inside of the other
  int inside;
  // of a HIT, in [0,1]: when the contact is that is proven, which need not be the first
  double time;
  // bytes of the certificate, also if there was no room for all
  size_t size;
  // that it took
  size_t visits;
} nsvcd_certificate;

// Bytes of the workspace that nsvcd_certify needs: some 300 for each pose of either, and 4 for each
// vertex of the mesh that has more.
NSVCDDEF size_t nsvcd_certify_workspace_size(const nsvcd_question *question,
                                             const nsvcd_tree *a, const nsvcd_tree *b);

// Proves the answer to a question anew, and writes the proof. It shares nothing with nsvcd_sweep
// but what a pose is, and how the nearest points of two triangles are found, which is checked.
// FREE: the two surfaces never come within the clearance, and neither is inside of the other. HIT:
// at a time that is told an edge passes through a triangle, or points are nearer than the
// clearance, or a corner is inside. UNDECIDED also: surfaces that only touch, with no edge through
// a triangle, or come nearer than 1e-10 of all lengths (of extents and of positions in the world).
//   question   not NULL; of it the poses, times and scales, and the clearance. Its bodies are not
//              used and may be NULL
//   a, b       trees of the meshes of question->a and question->b, not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_certify_workspace_size or more, not NULL, aligned to
//              NSVCD_ALIGNMENT
//   bytes      (capacity): the certificate, as far as there is room; NULL if capacity is 0. Free
//              motions take 40 to 300 bytes in the median, 2,000 in the mean and 90,000 at most
//   made       not NULL
//   allocates  nothing
//   errors     ARGUMENT, SLOP (if there is one), SCALE, POSES, TIMES, POSE, QUATERNION, CLEARANCE,
//              WORKSPACE
//   source     this library; examples/verify/nsvcd_verify.h describes the traversal. Planes by
//              Gilbert 1966
NSVCDDEF nsvcd_result nsvcd_certify(const nsvcd_question *question, const nsvcd_tree *a,
                                    const nsvcd_tree *b, const nsvcd_certify_options *options,
                                    void *workspace, size_t workspace_size, uint8_t *bytes,
                                    size_t capacity, nsvcd_certificate *made);

// Bytes of the workspace that nsvcd_certify_models needs. keyframes: of both models, 0 and 1 too.
NSVCDDEF size_t nsvcd_certify_models_workspace_size(size_t keyframes, const nsvcd_tree *a,
                                                    const nsvcd_tree *b);

// nsvcd_certify for any two motions; neuralsvcd_robot.h has those of a robot's joints.
//   models     (2), not NULL: of the meshes of a and b
//   keyframes  of both, 0 and 1 too; if there are more, UNDECIDED
//   errors     ARGUMENT, CLEARANCE, WORKSPACE
NSVCDDEF nsvcd_result nsvcd_certify_models(
    const nsvcd_motion_model *models, size_t keyframes, float clearance, const nsvcd_tree *a,
    const nsvcd_tree *b, const nsvcd_certify_options *options, void *workspace,
    size_t workspace_size, uint8_t *bytes, size_t capacity, nsvcd_certificate *made);
