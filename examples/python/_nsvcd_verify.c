// SPDX-License-Identifier: MIT
// _nsvcd_verify.c - the checker of certificates as the module nsvcd_verify loads it, with ctypes. It has
// nothing of neuralsvcd.h. What is prepared lies in memory of Python's, which does not look into it.
#include "examples/verify/nsvcd_verify_claim.h"

// Rays write to the sums of a mesh. So that threads may share one, a mover has a copy with its own.
typedef struct verifier_mover {
  nsvcd_verify_mesh mesh;
  nsvcd_verify_path path;
  nsvcd_verify_mover mover;
} verifier_mover;

size_t verifier_mesh_size(size_t vertices, size_t triangles) {
  return sizeof(nsvcd_verify_mesh) + NSVCD_VERIFY_MESH_BYTES(vertices, triangles);
}

const char *verifier_mesh_init(const float *positions, size_t vertices, const uint32_t *indices,
                               size_t triangles, nsvcd_verify_mesh *mesh) {
  return nsvcd_verify_mesh_init(positions, vertices, indices, triangles, mesh + 1, mesh);
}

size_t verifier_mover_size(size_t vertices) {
  return sizeof(verifier_mover) + vertices * sizeof(int32_t);
}

const char *verifier_mover_init(const nsvcd_verify_mesh *mesh, float scale, const float *poses,
                                const float *times, size_t count, verifier_mover *out) {
  out->mesh = *mesh;
  out->mesh.sums = (int32_t *)(out + 1);
  out->path.poses = poses;
  out->path.times = times;
  out->path.count = count;
  return nsvcd_verify_path_init(&out->mesh, scale, &out->path, &out->mover);
}

size_t verifier_workspace_size(const verifier_mover *a, const verifier_mover *b) {
  return NSVCD_VERIFY_WORKSPACE_BYTES(a->path.count + b->path.count + 2);
}

// Returns why a certificate is refused, or NULL; what it proves is in told: the kind, the time, what
// it names of a and of b; and of any one the position.
const char *verifier_verify(const verifier_mover *a, const verifier_mover *b, float clearance,
                            const uint8_t *bytes, size_t size, void *workspace, double told[5]) {
  nsvcd_verify_report report;
  const size_t room = verifier_workspace_size(a, b);
  (void)nsvcd_verify(&a->mover, &b->mover, clearance, bytes, size, workspace, room, &report);
  told[0] = (double)report.kind;
  told[1] = report.time;
  told[2] = (double)report.a;
  told[3] = (double)report.b;
  told[4] = (double)report.position;
  return report.reason;
}

void verifier_claim(const verifier_mover *a, const verifier_mover *b, float clearance,
                    uint8_t *claim) {
  (void)nsvcd_verify_claim(&a->mover, &b->mover, clearance, claim);
}
