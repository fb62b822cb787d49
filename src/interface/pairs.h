// In: a pair of a robot's parts, a motion of its joints, and the trees of their meshes. Out: bytes
// that prove that the two parts never meet.
#pragma once
#include "certificates.h"
#include "robots.h"

// Bytes of workspace that nsvcd_certify_pair needs: some 300 for each piece of the motion, and 4
// for each vertex of the mesh that has more.
//   motion     not NULL, as nsvcd_check takes it
//   a, b       trees of the meshes of the pair's parts, not NULL
NSVCDDEF size_t nsvcd_certify_pair_workspace_size(const nsvcd_joint_motion *motion,
                                                  const nsvcd_tree *a, const nsvcd_tree *b);

// Proves that a pair of parts never meets, as a motion of the joints moves them, and writes the
// proof: nsvcd_certify for a pair. FREE certificates of all pairs prove that the motion is free
// (examples/verify/nsvcd_verify_robot.h).
//   checker    not NULL
//   motion     not NULL, as nsvcd_check takes it, of one piece or more
//   pair       an index of the scene's pairs
//   clearance  metres
//   a, b       trees of the meshes of the pair's parts, not NULL
//   options    NULL: the defaults
//   workspace  (workspace_size) bytes, nsvcd_certify_pair_workspace_size or more, not NULL, aligned
//              to NSVCD_ALIGNMENT
//   bytes      (capacity): the certificate, as far as there is room; NULL if capacity is 0
//   made       not NULL; left as it was on failure
//   allocates  nothing
//   threads    each needs a checker and a workspace of its own; trees may be shared
//   errors     those of nsvcd_certify and nsvcd_check; PAIR; TURN (there are no pieces, or more
//              than NSVCD_MAX_POSES; or a piece takes less than 1e-9 of the motion's time; or a
//              joint is turned to more than 250 radians; or it moves as fast as 100,000 radians
//              or metres in the motion's time)
//   source     this library
NSVCDDEF nsvcd_result nsvcd_certify_pair(const nsvcd_checker *checker,
                                         const nsvcd_joint_motion *motion, size_t pair,
                                         float clearance, const nsvcd_tree *a,
                                         const nsvcd_tree *b,
                                         const nsvcd_certify_options *options, void *workspace,
                                         size_t workspace_size, uint8_t *bytes,
                                         size_t capacity, nsvcd_certificate *made);
