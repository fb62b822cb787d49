// certificate_scene.h - two bodies that move, at random, near each other: for the library, for the
// checker of certificates, and for the oracle. Include neuralsvcd.h, nsvcd_verify.h, shapes.h,
// oracle.h, poses.h and check.h before it.
#ifndef NSVCD_TESTS_CERTIFICATE_SCENE_H
#define NSVCD_TESTS_CERTIFICATE_SCENE_H

#include "mesh_of.h"

#define CERT_SHAPES 12
#define CERT_POSES 5
#define CERT_MOST_POSES 40  // of a scene with poses of its own
#define CERT_ROOM 65536

typedef struct cert_body {
  nsvcd_mesh mesh;
  const nsvcd_body *body;
  const nsvcd_tree *tree;
  nsvcd_verify_mesh checked;
  double *points;
  oracle_mesh exact;
} cert_body;

static void cert_make(shapes_mesh *shape, cert_body *out) {
  const size_t vertices = shape->vertices;
  memset(out, 0, sizeof *out);
  out->mesh = mesh_of(shape);
  CHECK_EQ(nsvcd_encode(&out->mesh, NULL, NULL, NULL, 0, &out->body), NSVCD_OK);
  const size_t size = nsvcd_tree_size(&out->mesh);
  CHECK_EQ(nsvcd_tree_build(&out->mesh, calloc(1, size), size, &out->tree), NSVCD_OK);
  void *memory = malloc(NSVCD_VERIFY_MESH_BYTES(vertices, shape->triangles));
  CHECK(!nsvcd_verify_mesh_init(out->mesh.positions, vertices, out->mesh.indices, shape->triangles,
                                memory, &out->checked));
  out->points = shape->positions;
  if (!oracle_mesh_init(&out->exact, out->points, vertices, shape->indices, shape->triangles, 1))
    exit(1);
  free(shape->indices);
}

static void cert_free(cert_body *b) {
  nsvcd_body_free(b->body, NULL);
  oracle_mesh_free(&b->exact);
  free((void *)(uintptr_t)b->tree);
  free(b->checked.boxes);
  free(b->mesh.positions);
  free(b->mesh.indices);
  free(b->points);
}

static void cert_split(shapes_mesh *shape) {  // every triangle has vertices of its own
  shapes_mesh split;
  memset(&split, 0, sizeof split);
  for (size_t i = 0; i < 3 * shape->triangles; i++) {
    const double *p = shape->positions + 3 * (size_t)shape->indices[i];
    const uint32_t v = shapes_vertex(&split, p[0], p[1], p[2]);
    if (i % 3 == 2) shapes_triangle(&split, v - 2, v - 1, v);
  }
  shapes_free(shape);
  *shape = split;
}

// Solids, a shell with a cavity, bodies of parts, one open sheet, and one whose vertices are split.
static cert_body *cert_bodies(void) {
  static cert_body made[CERT_SHAPES];
  if (made[0].body) return made;
  for (int n = 0; n < CERT_SHAPES; n++) {
    shapes_mesh m;
    memset(&m, 0, sizeof m);
    if (n == 0) shapes_box(&m, 0.2, 0.2, 0.2, 1);
    if (n == 1) shapes_capsule(&m, 0.04, 0.3, 10);
    if (n == 2) shapes_box(&m, 0.3, 0.3, 0.004, 2);
    if (n == 3) shapes_torus(&m, 0.12, 0.03, 20, 10);
    if (n == 4) shapes_l_bracket(&m, 0.2, 0.15, 0.03, 0.05);
    if (n == 5) shapes_bowl(&m, 0.12, 0.08, 0.01, 20);
    if (n == 6) shapes_shell(&m, 0.3, 0.3, 0.3, 0.02, 1, 16);
    if (n == 7) shapes_box_at(&m, 0.15, 0, 0, 0.08, 0.08, 0.08);
    if (n == 7) shapes_box_at(&m, -0.15, 0, 0, 0.08, 0.08, 0.08);
    if (n == 8) shapes_ellipsoid(&m, 0.15, 0.1, 0.08, 24);
    if (n == 9) shapes_box(&m, 0.05, 0.05, 0.05, 1);
    if (n == 10) shapes_box(&m, 0.2, 0.15, 0.1, 1);
    if (n == 11) shapes_box(&m, 0.2, 0.2, 0.2, 4);
    if (n == 11) m.triangles -= 30;
    if (n == 10) cert_split(&m);
    cert_make(&m, &made[n]);
  }
  return made;
}

// ---- scenes

typedef struct cert_scene {
  const cert_body *a, *b;
  nsvcd_pose poses[2][CERT_POSES];
  float times[2][CERT_POSES];
  nsvcd_question question;
} cert_scene;

static void cert_random_poses(shapes_rng *rng, nsvcd_pose *poses, float *times, size_t count,
                              double reach, double turn) {
  double q[4];
  shapes_quaternion(rng, q);
  for (size_t k = 0; k < count; k++) {
    double axis[3], by[4], next[4];
    oracle_pose pose;
    shapes_direction(rng, axis);
    oracle_axis_angle(axis, shapes_uniform(rng, 0, turn), by);
    oracle_quat_mul(by, q, next);
    memcpy(q, next, sizeof q);
    memcpy(pose.rotation, q, sizeof q);
    for (int i = 0; i < 3; i++) pose.position[i] = shapes_uniform(rng, -reach, reach);
    // the same turn, on either side
    for (int i = 0; i < 4 && k % 2; i++) pose.rotation[i] = -q[i];
    poses[k] = pose_rounded(&pose);
    times[k] =
        count > 1
            ? ((float)k + (k > 0 && k + 1 < count ? (float)shapes_uniform(rng, -0.4, 0.4) : 0)) /
                  (float)(count - 1)
            : 0;
  }
}

static void cert_random(cert_scene *s, shapes_rng *rng) {
  cert_body *bodies = cert_bodies();
  nsvcd_mover *movers[2] = {&s->question.a, &s->question.b};
  memset(s, 0, sizeof *s);
  s->a = &bodies[shapes_pick(rng, CERT_SHAPES)];
  s->b = &bodies[shapes_pick(rng, CERT_SHAPES)];
  const int within = shapes_pick(rng, 6) == 0;  // something small near the middle of something
  if (within) s->a = &bodies[9];
  for (int n = 0; n < 2; n++) {
    const int moves = n == 0 || shapes_pick(rng, 3) == 0;
    nsvcd_mover *m = movers[n];
    m->body = n ? s->b->body : s->a->body;
    m->poses = s->poses[n];
    m->count = moves ? 1 + (size_t)shapes_pick(rng, CERT_POSES) : 1;
    m->scale = shapes_pick(rng, 2) ? 0 : (float)shapes_uniform(rng, 0.3, 2);
    if (within && n == 0) m->scale = 0.3f;
    m->times = m->count > 1 && shapes_pick(rng, 3) == 0 ? s->times[n] : NULL;
    cert_random_poses(rng, s->poses[n], s->times[n], m->count, n || within ? 0.1 : 0.35,
                      shapes_pick(rng, 4) ? 1.0 : 2.9);
  }
  if (shapes_pick(rng, 3) == 0) s->question.clearance = (float)shapes_uniform(rng, 0.001, 0.05);
}

// The question of a scene, or of a copy of one, is about its own poses.
static void cert_own(cert_scene *s) {
  nsvcd_mover *movers[2] = {&s->question.a, &s->question.b};
  for (int n = 0; n < 2; n++) {
    movers[n]->poses = s->poses[n];
    if (movers[n]->times) movers[n]->times = s->times[n];
  }
}
// Two bodies that rest at the origin; so are the poses that they do not have yet.
static void cert_rest(cert_scene *s, const cert_body *a, const cert_body *b) {
  memset(s, 0, sizeof *s);
  s->a = a;
  s->b = b;
  for (int k = 0; k < 2 * CERT_POSES; k++) s->poses[k % 2][k / 2].rotation[3] = 1;
  s->question.a.count = s->question.b.count = 1;
  cert_own(s);
}

static double cert_scale(const nsvcd_mover *mover) {
  return mover->scale > 0 ? (double)mover->scale : 1;
}

// Where a mover is at a time, by the oracle.
static oracle_pose cert_pose_at(const nsvcd_mover *mover, double t) {
  size_t k = 0;
  if (mover->count == 1) return pose_widened(mover->poses);
  const double last = (double)(mover->count - 1);
  while (k + 2 < mover->count &&
         (mover->times ? (double)mover->times[k + 1] : (double)(k + 1) / last) <= t)
    k++;
  const double from = mover->times ? (double)mover->times[k] : (double)k / last;
  const double to = mover->times ? (double)mover->times[k + 1] : (double)(k + 1) / last;
  const oracle_pose a = pose_widened(&mover->poses[k]);
  const oracle_pose b = pose_widened(&mover->poses[k + 1]);
  return oracle_pose_between(&a, &b, (t - from) / (to - from));
}

// How often one of them winds about a corner of the other at a time.
static double cert_winding(const cert_scene *s, double t, uint32_t corner, int of_b) {
  const nsvcd_mover *movers[2] = {&s->question.a, &s->question.b};
  const cert_body *of = of_b ? s->b : s->a;
  const cert_body *by = of_b ? s->a : s->b;
  const oracle_pose of_at = cert_pose_at(movers[of_b], t);
  const oracle_pose by_at = cert_pose_at(movers[!of_b], t);
  double x[3], m[9], local[3];
  for (int k = 0; k < 3; k++)
    x[k] = cert_scale(movers[of_b]) * of->points[3 * corner + (uint32_t)k];
  oracle_transform(&of_at, x, x);
  oracle_sub(x, by_at.position, x);
  oracle_matrix(by_at.rotation, m);
  oracle_rotate_back(m, x, local);
  for (int k = 0; k < 3; k++) local[k] /= cert_scale(movers[!of_b]);
  return oracle_winding(&by->exact, local);
}

// How near the two come at a time, metres, up to a limit; and whether a part of one is inside the
// other. All is seen from a in units of its scale: then one of both needs no other size.
static double cert_apart(const cert_scene *s, double t, double limit, int *inside) {
  static oracle_mesh scaled;
  static const cert_body *whose;
  static double by;
  const double scale_a = cert_scale(&s->question.a);
  const double ratio = cert_scale(&s->question.b) / scale_a;
  if (whose != s->b || by < ratio || by > ratio) {
    const nsvcd_mesh *m = &s->b->mesh;
    oracle_mesh_free(&scaled);
    if (!oracle_mesh_init(&scaled, s->b->points, m->vertex_count, m->indices, m->triangle_count,
                          ratio))
      exit(1);
    whose = s->b;
    by = ratio;
  }
  oracle_pose poses[2] = {cert_pose_at(&s->question.a, t), cert_pose_at(&s->question.b, t)};
  for (int k = 0; k < 3; k++) {
    poses[0].position[k] /= scale_a;
    poses[1].position[k] /= scale_a;
  }
  oracle_search search;
  oracle_search_begin(&search, &s->a->exact, &scaled);
  // what is open encloses nothing, whatever its solid angle is
  const cert_body *open = &cert_bodies()[CERT_SHAPES - 1];
  if (inside)
    *inside = (s->b != open && oracle_inside(&s->a->exact, &poses[0], &scaled, &poses[1]) > 0.6) ||
              (s->a != open && oracle_inside(&scaled, &poses[1], &s->a->exact, &poses[0]) > 0.6);
  return scale_a * oracle_search_run(&search, &poses[0], &poses[1], limit / scale_a);
}

// ---- certificates of them

static nsvcd_result cert_certify(const cert_scene *s, const nsvcd_answer *answer, uint8_t *bytes,
                                 size_t room, nsvcd_certificate *made) {
  const nsvcd_certify_options options = {answer, 200000};
  const size_t size = nsvcd_certify_workspace_size(&s->question, s->a->tree, s->b->tree);
  void *workspace = malloc(size);
  const nsvcd_result result = nsvcd_certify(&s->question, s->a->tree, s->b->tree, &options,
                                            workspace, size, bytes, room, made);
  free(workspace);
  return result;
}

// The checker's view of a scene; what it refuses of paths is said by `why`.
typedef struct cert_view {
  nsvcd_verify_path paths[2];
  nsvcd_verify_mover movers[2];
  const char *why;
} cert_view;

static void cert_look(const cert_scene *s, cert_view *view) {
  const nsvcd_mover *movers[2] = {&s->question.a, &s->question.b};
  memset(view, 0, sizeof *view);
  for (int n = 0; n < 2 && !view->why; n++) {
    view->paths[n].poses = movers[n]->poses->position;
    view->paths[n].times = movers[n]->times;
    view->paths[n].count = movers[n]->count;
    view->why =
        nsvcd_verify_path_init(n ? &s->b->checked : &s->a->checked, (float)cert_scale(movers[n]),
                               &view->paths[n], &view->movers[n]);
  }
}

static int cert_check(const cert_view *view, float clearance, const uint8_t *bytes, size_t size,
                      nsvcd_verify_report *report) {
  static double workspace[(2 * CERT_MOST_POSES + 2) * sizeof(verify__instant) / sizeof(double)];
  return nsvcd_verify(&view->movers[0], &view->movers[1], clearance, bytes, size, workspace,
                      sizeof workspace, report);
}

// Puts the digests of one certificate, which are in its second to fifth byte, into another.
static void cert_forge(uint8_t *bytes, const uint8_t *from) {
  memcpy(bytes + 1, from + 1, 4);
}
#endif
