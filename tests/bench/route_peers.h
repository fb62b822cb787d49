// route_peers.h - other ways to ask whether a motion of the joints is free, for the same planner:
// samples of the motion, and at each the pairs by a mesh hierarchy or by spheres.
//
// bench_routes.c is compiled with a copy of neuralsvcd.h in which the planner calls peer_check in
// place of nsvcd_check, and nothing else differs. Include neuralsvcd.h and arm_scene.h first.
#ifndef NSVCD_BENCH_ROUTE_PEERS_H
#define NSVCD_BENCH_ROUTE_PEERS_H

#include "mesh.h"
#include "spheres.h"

typedef struct route_peer {
  const char *name;
  const method *by;  // NULL: the library's proof
  preparation how;
  double step;  // radians that a joint goes from sample to sample, at most
} route_peer;

static const route_peer route_peers[] = {
    {"proofs", NULL, {0, 0}, 0},
    {"mesh hierarchy, 0.02 rad", &full_mesh_method, {0, 0}, 0.02},
    {"mesh hierarchy, 0.005 rad", &full_mesh_method, {0, 0}, 0.005},
    {"spheres, few, 0.02 rad", &spheres_method, {0.03f, 100}, 0.02},
    {"spheres, many, 0.02 rad", &spheres_method, {0.01f, 1000}, 0.02},
};
#define ROUTE_PEERS_COUNT (sizeof route_peers / sizeof route_peers[0])

static const route_peer *peer_now = &route_peers[0];
static void *peer_bodies[ARM_MOST_PARTS];
static uint32_t peer_last[2];  // the pair that was hit last, which is asked first

static void peer_prepare(const arm_scene *s, const route_peer *peer) {
  peer_now = peer;
  for (size_t n = 0; n < s->scene.part_count && peer->by; n++) {
    const oracle_mesh *exact = &s->meshes[n];
    nsvcd_mesh mesh;
    mesh.vertex_count = 3 * exact->triangle_count;
    mesh.triangle_count = exact->triangle_count;
    mesh.positions = (float *)malloc(9 * exact->triangle_count * sizeof(float));
    mesh.indices = (uint32_t *)malloc(3 * exact->triangle_count * sizeof(uint32_t));
    if (!mesh.positions || !mesh.indices) exit(1);
    for (size_t i = 0; i < 9 * exact->triangle_count; i++)
      mesh.positions[i] = (float)exact->triangles[i / 9].v[i / 3 % 3][i % 3];
    for (size_t i = 0; i < mesh.vertex_count; i++) mesh.indices[i] = (uint32_t)i;
    peer_bodies[n] = peer->by->prepare(&mesh, &peer->how);
    if (!peer_bodies[n]) exit(1);
    free(mesh.positions);
    free(mesh.indices);
  }
  peer_last[0] = peer_last[1] = 0;
}

static void peer_release(const arm_scene *s) {
  for (size_t n = 0; n < s->scene.part_count && peer_now->by; n++)
    peer_now->by->release(peer_bodies[n]);
}

static void peer_rotation(const float *q, float *m) {
  const float x = q[0], y = q[1], z = q[2], w = q[3];
  const float out[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                        2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                        2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
  memcpy(m, out, sizeof out);
}

// a in the frame of b.
static transform peer_placement(const nsvcd_pose *a, const nsvcd_pose *b) {
  transform out;
  float ma[9], mb[9];
  peer_rotation(a->rotation, ma);
  peer_rotation(b->rotation, mb);
  for (int i = 0; i < 3; i++) {
    out.position[i] = 0;
    for (int k = 0; k < 3; k++)
      out.position[i] += mb[3 * k + i] * (a->position[k] - b->position[k]);
    for (int j = 0; j < 3; j++) {
      out.rotation[3 * i + j] = 0;
      for (int k = 0; k < 3; k++) out.rotation[3 * i + j] += mb[3 * k + i] * ma[3 * k + j];
    }
  }
  return out;
}

static int peer_hits(const nsvcd_body_pair *pair, const nsvcd_pose *poses) {
  const transform at = peer_placement(&poses[pair->a], &poses[pair->b]);
  return peer_now->by->hits(peer_bodies[pair->a], peer_bodies[pair->b], &at, 1, 0);
}

static int peer_hits_at(const nsvcd_checker *c, const double *joints) {
  nsvcd_pose poses[ARM_MOST_PARTS];
  const nsvcd_body_pair last = {peer_last[0], peer_last[1]};
  nsvcd_forward_kinematics(c, joints, poses);
  if (last.a != last.b && peer_hits(&last, poses)) return 1;
  for (size_t p = 0; p < c->scene->pair_count; p++) {
    const nsvcd_body_pair *pair = &c->scene->pairs[p];
    if (!peer_hits(pair, poses)) continue;
    peer_last[0] = pair->a;
    peer_last[1] = pair->b;
    return 1;
  }
  return 0;
}

// Samples of a piece, the ends and the middle first: 0, 1, 1/2, 1/4, 3/4 and so on.
static int peer_hits_in(const nsvcd_checker *c, const nsvcd_joint_motion *m, size_t piece) {
  const size_t joints = c->scene->joint_count;
  double joints_at[NSVCD_MAX_JOINTS];
  double way = 0;
  for (size_t j = 0; j < joints; j++) {
    const double *p = m->points + piece * m->degree * joints + j;
    double own = 0;
    for (size_t i = 0; i < m->degree; i++) own += fabs(p[(i + 1) * joints] - p[i * joints]);
    way = fmax(way, own);
  }
  size_t steps = 1;
  while (way / (double)steps > peer_now->step) steps *= 2;
  for (size_t stride = steps; stride > 0; stride /= 2) {
    for (size_t k = 0; k <= steps; k += stride) {
      if (stride < steps && k % (2 * stride) == 0) continue;
      nsvcd__joints_at(m, joints, piece, (double)k / (double)steps, joints_at, NULL);
      if (peer_hits_at(c, joints_at)) return 1;
    }
  }
  return 0;
}

// In place of nsvcd_check.
static nsvcd_result peer_check(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                               const nsvcd_check_options *options, nsvcd_check_answer *answer) {
  if (!peer_now->by) return nsvcd_check(c, motion, options, answer);
  memset(answer, 0, sizeof *answer);
  answer->pair = answer->piece = answer->joint = NSVCD_NONE;
  answer->verdict = NSVCD_FREE;
  for (size_t p = 0; p < motion->pieces && answer->joint == NSVCD_NONE; p++)
    answer->joint = nsvcd__joint_outside(c->scene, motion, p);
  for (size_t p = 0; p < motion->pieces && answer->verdict == NSVCD_FREE; p++)
    if (peer_hits_in(c, motion, p)) answer->verdict = NSVCD_HIT;
  if (!motion->pieces && peer_hits_at(c, motion->points)) answer->verdict = NSVCD_HIT;
  return NSVCD_OK;
}
#endif  // NSVCD_BENCH_ROUTE_PEERS_H
