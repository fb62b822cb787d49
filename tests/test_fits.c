// Close fits: shafts in bores, a nut on its bolt, gears, a piston, a hinge, a drawer. They are free by
// construction, and are proven so by default; so are their certificates, and none of what is not
// free is ever accepted.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_certify.h"

#include "../examples/verify/nsvcd_verify.h"
#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "check.h"
#include "fits_scene.h"

void test_fits(void);

typedef struct fits_body {
  nsvcd_mesh mesh;
  const nsvcd_body *body;
  const nsvcd_tree *tree;
  nsvcd_verify_mesh checked;
  void *memory[2];
  oracle_mesh exact;
} fits_body;

// The mesh stays: it is read from there.
static void fits_body_init(shapes_mesh *shape, fits_body *out) {
  memset(out, 0, sizeof *out);
  out->mesh.vertex_count = shape->vertices;
  out->mesh.triangle_count = shape->triangles;
  out->mesh.positions = (float *)calloc(3 * shape->vertices, sizeof(float));
  out->mesh.indices = shape->indices;
  for (size_t i = 0; i < 3 * shape->vertices; i++) {
    out->mesh.positions[i] = pose_to_float(shape->positions[i]);
    shape->positions[i] = (double)out->mesh.positions[i];
  }
  CHECK_EQ(nsvcd_encode(&out->mesh, NULL, NULL, NULL, 0, &out->body), NSVCD_OK);
  const size_t size = nsvcd_tree_size(&out->mesh);
  out->memory[0] = calloc(1, size);
  CHECK_EQ(nsvcd_tree_build(&out->mesh, out->memory[0], size, &out->tree), NSVCD_OK);
  out->memory[1] = malloc(NSVCD_VERIFY_MESH_BYTES(shape->vertices, shape->triangles));
  CHECK(!nsvcd_verify_mesh_init(out->mesh.positions, shape->vertices, out->mesh.indices,
                                shape->triangles, out->memory[1], &out->checked));
  CHECK(oracle_mesh_init(&out->exact, shape->positions, shape->vertices, shape->indices,
                         shape->triangles, 1));
}

static void fits_body_free(fits_body *b) {
  nsvcd_body_free(b->body, NULL);
  oracle_mesh_free(&b->exact);
  free(b->memory[0]);
  free(b->memory[1]);
  free(b->mesh.positions);
}

static nsvcd_question fits_question(const fits_case *f, const fits_body *a, const fits_body *b) {
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  q.a.body = a->body;
  q.a.poses = f->poses_a;
  q.a.count = f->count_a;
  q.b.body = b->body;
  q.b.poses = f->poses_b;
  q.b.count = f->count_b;
  return q;
}

static nsvcd_answer fits_ask(const nsvcd_question *q) {
  nsvcd_answer answer;
  const size_t size = nsvcd_sweep_workspace_size(q);
  void *workspace = malloc(size);
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_sweep(q, workspace, size, &answer), NSVCD_OK);
  free(workspace);
  return answer;
}

// Of those that take the least time one of each kind. units: what they took, and some more; before
// distances were those from the axis, the shafts, the hinge and the gears took two to ten times that.
static const struct {
  size_t number, units;
} fits_looked_at[] = {{0, 60000},   {3, 200000},  {4, 80000},   {10, 90000}, {16, 130000},
                      {24, 600000}, {28, 270000}, {30, 350000}, {31, 80000}, {32, 30000}};
#define FITS_LOOKED_AT (sizeof fits_looked_at / sizeof *fits_looked_at)

static void fits_are_free_by_default(void) {
  for (size_t n = 0; n < FITS_LOOKED_AT; n++) {
    fits_case f;
    fits_body a, b;
    CHECK(fits_make(fits_looked_at[n].number, &f));
    fits_body_init(&f.a, &a);
    fits_body_init(&f.b, &b);
    nsvcd_question q = fits_question(&f, &a, &b);
    nsvcd_answer answer = fits_ask(&q);
    printf("  %-44s %7zu units\n", f.name, answer.work);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    CHECK_LE(answer.work, fits_looked_at[n].units);
    // not free by more than that
    q.clearance = (float)(1.05 * f.gap);
    if (fits_looked_at[n].number < 24) {
      answer = fits_ask(&q);
      CHECK(answer.verdict != NSVCD_FREE);
    }
    fits_body_free(&a);
    fits_body_free(&b);
    fits_free(&f);
  }
}

typedef struct fits_view {
  nsvcd_verify_path paths[2];
  nsvcd_verify_mover movers[2];
} fits_view;

static void fits_look(const fits_case *f, const fits_body *a, const fits_body *b, fits_view *out) {
  const nsvcd_pose *poses[2] = {f->poses_a, f->poses_b};
  const size_t counts[2] = {f->count_a, f->count_b};
  const fits_body *bodies[2] = {a, b};
  for (int n = 0; n < 2; n++) {
    out->paths[n].poses = poses[n][0].position;
    out->paths[n].times = NULL;
    out->paths[n].count = counts[n];
    CHECK(!nsvcd_verify_path_init(&bodies[n]->checked, 1, &out->paths[n], &out->movers[n]));
  }
}

static nsvcd_certificate fits_certify(const nsvcd_question *q, const fits_body *a,
                                      const fits_body *b, uint8_t *bytes, size_t room) {
  nsvcd_certificate made;
  const size_t size = nsvcd_certify_workspace_size(q, a->tree, b->tree);
  void *workspace = malloc(size);
  memset(&made, 0, sizeof made);
  CHECK_EQ(nsvcd_certify(q, a->tree, b->tree, NULL, workspace, size, bytes, room, &made), NSVCD_OK);
  free(workspace);
  return made;
}

static int fits_verify(const fits_view *view, const uint8_t *bytes, size_t size) {
  static uint64_t workspace[NSVCD_VERIFY_WORKSPACE_BYTES(2 * FITS_POSES) / 8];
  nsvcd_verify_report report;
  return nsvcd_verify(&view->movers[0], &view->movers[1], 0, bytes, size, workspace,
                      sizeof workspace, &report);
}

// The certificate of each is accepted, and is no longer than it was once, and some more.
static void fits_certificates_are_accepted(void) {
  static uint8_t bytes[1 << 20];
  static const struct {
    size_t number, visits;
  } looked_at[] = {{0, 25000}, {4, 40000}, {31, 70000}, {33, 1200}};
  for (size_t n = 0; n < sizeof looked_at / sizeof *looked_at; n++) {
    fits_case f;
    fits_body a, b;
    fits_view view;
    CHECK(fits_make(looked_at[n].number, &f));
    fits_body_init(&f.a, &a);
    fits_body_init(&f.b, &b);
    const nsvcd_question q = fits_question(&f, &a, &b);
    const nsvcd_certificate made = fits_certify(&q, &a, &b, bytes, sizeof bytes);
    fits_look(&f, &a, &b, &view);
    printf("  %-44s %7zu visits, %6zu bytes\n", f.name, made.visits, made.size);
    CHECK_EQ(made.verdict, NSVCD_FREE);
    CHECK_LE(made.visits, looked_at[n].visits);
    CHECK_LE(made.size, sizeof bytes);
    CHECK(fits_verify(&view, bytes, made.size));
    fits_body_free(&a);
    fits_body_free(&b);
    fits_free(&f);
  }
}

// ---- what the checker takes of a turn, at its limit

// A triangle turns, another rests, and a plane of some normal is to keep them so far apart that the
// checker just takes it: then they are, at all times, along that normal.
static double fits_at_the_limit(shapes_rng *rng) {
  static uint64_t workspace[NSVCD_VERIFY_WORKSPACE_BYTES(8) / 8];
  shapes_mesh shapes[2];
  fits_body bodies[2];
  fits_case f;
  fits_view view;
  verify__reader r;
  verify__visit v;
  double axis[3], start[4], n[3];
  memset(shapes, 0, sizeof shapes);
  memset(&f, 0, sizeof f);
  memset(&r, 0, sizeof r);
  memset(&v, 0, sizeof v);
  shapes_direction(rng, axis);
  shapes_direction(rng, n);
  shapes_quaternion(rng, start);
  const double slim = pow(10, shapes_uniform(rng, -3, 0));
  for (int k = 0; k < 2; k++) {
    for (int c = 0; c < 3; c++) {
      double x[3];
      shapes_direction(rng, x);
      const double along = shapes_uniform(rng, -1, 1);  // near the axis of the turn
      for (int i = 0; i < 3; i++) x[i] = slim * x[i] + (k ? -3 * n[i] : along * axis[i]);
      shapes_vertex(&shapes[k], x[0], x[1], x[2]);
    }
    shapes_triangle(&shapes[k], 0, 1, 2);
    fits_body_init(&shapes[k], &bodies[k]);
  }
  f.count_a = 2;
  f.count_b = 1;
  for (int k = 0; k < 2; k++) {
    oracle_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
    double turn[4];
    oracle_axis_angle(axis, k * shapes_uniform(rng, 0.01, 3), turn);
    oracle_quat_mul(start, turn, pose.rotation);
    for (int i = 0; i < 3; i++) pose.position[i] = k * shapes_uniform(rng, -0.1, 0.1);
    f.poses_a[k] = pose_rounded(&pose);
  }
  fits_move(f.poses_b, 1, 0, 0, fits_origin, fits_origin);
  fits_look(&f, &bodies[0], &bodies[1], &view);
  r.a = &view.movers[0];
  r.b = &view.movers[1];
  r.instants = (verify__instant *)(void *)workspace;
  r.capacity = 8;
  memcpy(r.normals[0], n, sizeof n);
  v.a.count = v.b.count = 1;
  v.t0 = shapes_uniform(rng, 0, 0.5);
  v.t1 = v.t0 + shapes_uniform(rng, 0.1, 0.5);
  CHECK(verify__instants(&r, v.t0, v.t1));
  double low = 0;
  double high = 10;
  for (int k = 0; k < 60; k++) {
    r.clearance = 0.5 * (low + high);
    const int taken = verify__parts(&r, &v, 1);
    low = taken ? r.clearance : low;
    high = taken ? high : r.clearance;
  }
  const oracle_pose from = pose_widened(&f.poses_a[0]);
  const oracle_pose to = pose_widened(&f.poses_a[1]);
  double least = HUGE_VAL;
  double at_ends = HUGE_VAL;
  for (int k = 0; k <= 64; k++) {
    const oracle_pose pose = oracle_pose_between(&from, &to, v.t0 + (v.t1 - v.t0) * k / 64);
    double gap = HUGE_VAL;
    for (int c = 0; c < 9; c++) {
      double x[3];
      oracle_transform(&pose, shapes[0].positions + 3 * (c / 3), x);
      const double *y = shapes[1].positions + 3 * (c % 3);
      gap = fmin(gap, oracle_dot(n, x) - oracle_dot(n, y));
    }
    least = fmin(least, gap);
    if (k % 64 == 0) at_ends = fmin(at_ends, gap);
  }
  CHECK_GE(least, low);
  for (int k = 0; k < 2; k++) {
    fits_body_free(&bodies[k]);
    shapes_free(&shapes[k]);
  }
  return at_ends - low > 1e-6 ? (at_ends - least) / (at_ends - low) : 0;
}

static void fits_hold_at_the_limit(void) {
  shapes_rng rng = {46};
  double tightest = 0;
  for (size_t trial = 0; trial < check_many(3000); trial++)
    tightest = fmax(tightest, fits_at_the_limit(&rng));
  printf("  at most %.3g of what is allowed\n", tightest);
  CHECK_GE(tightest, 0.9);
}

void test_fits(void) {
  RUN(fits_hold_at_the_limit);
  RUN(fits_are_free_by_default);
  RUN(fits_certificates_are_accepted);
}
CHECK_ALONE(test_fits)
