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
#include "certificate_scene.h"
#include "fits_scene.h"

void test_fits(void);

// A case as the library, the checker and the oracle have it.
static void fits_open(fits_case *f, cert_body bodies[2], cert_scene *s) {
  cert_make(&f->a, &bodies[0]);
  cert_make(&f->b, &bodies[1]);
  cert_rest(s, &bodies[0], &bodies[1]);
  s->question.a = (nsvcd_mover){.body = bodies[0].body, .poses = f->poses_a, .count = f->count_a};
  s->question.b = (nsvcd_mover){.body = bodies[1].body, .poses = f->poses_b, .count = f->count_b};
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
    cert_body bodies[2];
    cert_scene s;
    CHECK(fits_make(fits_looked_at[n].number, &f));
    fits_open(&f, bodies, &s);
    nsvcd_answer answer = fits_ask(&s.question);
    printf("  %-44s %7zu units\n", f.name, answer.work);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    CHECK_LE(answer.work, fits_looked_at[n].units);
    // not free by more than that
    s.question.clearance = (float)(1.05 * f.gap);
    if (fits_looked_at[n].number < 24) CHECK(fits_ask(&s.question).verdict != NSVCD_FREE);
    for (int k = 0; k < 2; k++) cert_free(&bodies[k]);
  }
}

// The certificate of each is accepted, and is no longer than it was once, and some more.
static void fits_certificates_are_accepted(void) {
  static uint8_t bytes[1 << 20];
  static const struct {
    size_t number, visits;
  } looked_at[] = {{0, 25000}, {4, 40000}, {31, 70000}, {33, 1200}};
  for (size_t n = 0; n < sizeof looked_at / sizeof *looked_at; n++) {
    fits_case f;
    cert_body bodies[2];
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    memset(&made, 0, sizeof made);
    CHECK(fits_make(looked_at[n].number, &f));
    fits_open(&f, bodies, &s);
    CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
    cert_look(&s, &view);
    printf("  %-44s %7zu visits, %6zu bytes\n", f.name, made.visits, made.size);
    CHECK_EQ(made.verdict, NSVCD_FREE);
    CHECK_LE(made.visits, looked_at[n].visits);
    CHECK_LE(made.size, sizeof bytes);
    CHECK(!view.why && cert_check(&view, 0, bytes, made.size, &report));
    for (int k = 0; k < 2; k++) cert_free(&bodies[k]);
  }
}

// ---- what the checker takes of a turn, at its limit

// A triangle turns, another rests, and a plane of some normal is to keep them so far apart that the
// checker just takes it: then they are, at all times, along that normal.
static double fits_at_the_limit(shapes_rng *rng) {
  static uint64_t workspace[NSVCD_VERIFY_WORKSPACE_BYTES(8) / 8];
  cert_body bodies[2];
  cert_scene s;
  cert_view view;
  verify__reader r;
  verify__visit v;
  double axis[3], start[4], n[3];
  memset(&r, 0, sizeof r);
  memset(&v, 0, sizeof v);
  shapes_direction(rng, axis);
  shapes_direction(rng, n);
  shapes_quaternion(rng, start);
  const double slim = pow(10, shapes_uniform(rng, -3, 0));
  for (int k = 0; k < 2; k++) {
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    for (int c = 0; c < 3; c++) {
      double x[3];
      shapes_direction(rng, x);
      const double along = shapes_uniform(rng, -1, 1);  // near the axis of the turn
      for (int i = 0; i < 3; i++) x[i] = slim * x[i] + (k ? -3 * n[i] : along * axis[i]);
      shapes_vertex(&shape, x[0], x[1], x[2]);
    }
    shapes_triangle(&shape, 0, 1, 2);
    cert_make(&shape, &bodies[k]);
  }
  cert_rest(&s, &bodies[0], &bodies[1]);
  s.question.a.count = 2;
  for (int k = 0; k < 2; k++) {
    oracle_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
    double turn[4];
    oracle_axis_angle(axis, k * shapes_uniform(rng, 0.01, 3), turn);
    oracle_quat_mul(start, turn, pose.rotation);
    for (int i = 0; i < 3; i++) pose.position[i] = k * shapes_uniform(rng, -0.1, 0.1);
    s.poses[0][k] = pose_rounded(&pose);
  }
  cert_look(&s, &view);
  CHECK(!view.why);
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
  const oracle_pose from = pose_widened(&s.poses[0][0]);
  const oracle_pose to = pose_widened(&s.poses[0][1]);
  double least = HUGE_VAL;
  double at_ends = HUGE_VAL;
  for (int k = 0; k <= 64; k++) {
    const oracle_pose pose = oracle_pose_between(&from, &to, v.t0 + (v.t1 - v.t0) * k / 64);
    double gap = HUGE_VAL;
    for (int c = 0; c < 9; c++) {
      double x[3];
      oracle_transform(&pose, bodies[0].points + 3 * (c / 3), x);
      const double *y = bodies[1].points + 3 * (c % 3);
      gap = fmin(gap, oracle_dot(n, x) - oracle_dot(n, y));
    }
    least = fmin(least, gap);
    if (k % 64 == 0) at_ends = fmin(at_ends, gap);
  }
  CHECK_GE(least, low);
  for (int k = 0; k < 2; k++) cert_free(&bodies[k]);
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
