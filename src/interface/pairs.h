// In: a pair of a robot's parts, a motion of its joints, and the trees of their meshes. Out: bytes
// that prove that the two never meet.
#pragma once
#include "certificates.h"
#include "robots.h"

// Bytes of the workspace of nsvcd_certify_pair: some 300 for each piece, and 4 for each vertex of
// the mesh that has more.
NSVCDDEF size_t nsvcd_certify_pair_workspace_size(const nsvcd_joint_motion *motion,
                                                  const nsvcd_tree *a, const nsvcd_tree *b);

// nsvcd_certify for a pair of parts, as a motion of the joints moves them. FREE certificates of all
// pairs prove that the motion is free (examples/verify/nsvcd_verify_robot.h).
//   checker    not NULL
//   motion     not NULL, as nsvcd_check takes it, of one piece or more
//   pair       of the scene's pairs
//   clearance  metres
//   a, b       trees of the meshes of the pair's parts, not NULL
//   errors     those of nsvcd_certify and nsvcd_check, PAIR, and TURN: no pieces, or more than
//              NSVCD_MAX_POSES; one that takes less than 1e-9 of the motion's time; a joint that is
//              turned by more than 1,000, or as fast as 100,000 in that time
NSVCDDEF nsvcd_result nsvcd_certify_pair(const nsvcd_checker *checker,
                                         const nsvcd_joint_motion *motion, size_t pair,
                                         float clearance, const nsvcd_tree *a,
                                         const nsvcd_tree *b,
                                         const nsvcd_certify_options *options, void *workspace,
                                         size_t workspace_size, uint8_t *bytes,
                                         size_t capacity, nsvcd_certificate *made);
