// The oracle judges the library; these tests judge the oracle: closed forms, brute force, dense
// sampling, libccd.
#include "../examples/scenery/oracle.h"

#include "../examples/scenery/shapes.h"
#include "check.h"

#ifdef HAVE_LIBCCD
#include <ccd/ccd.h>
#include <ccd/quat.h>
#endif

void test_oracle(void);

static const oracle_pose identity = {{0, 0, 0}, {0, 0, 0, 1}};

static oracle_pose at(double x, double y, double z) {
  oracle_pose pose = identity;
  pose.position[0] = x;
  pose.position[1] = y;
  pose.position[2] = z;
  return pose;
}
static oracle_pose random_pose(shapes_rng *rng, double reach) {
  oracle_pose pose;
  for (int k = 0; k < 3; k++) pose.position[k] = shapes_uniform(rng, -reach, reach);
  shapes_quaternion(rng, pose.rotation);
  return pose;
}
static oracle_mesh build(shapes_mesh *mesh) {
  oracle_mesh out;
  int built =
      oracle_mesh_init(&out, mesh->positions, mesh->vertices, mesh->indices, mesh->triangles, 1);
  CHECK(built && !mesh->failed);
  shapes_free(mesh);
  return out;
}
static oracle_mesh box(double x, double y, double z) {
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_box(&mesh, x, y, z, 2);
  return build(&mesh);
}
static oracle_mesh sphere(double radius, int segments) {
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_capsule(&mesh, radius, 0, segments);
  return build(&mesh);
}
static oracle_mesh random_solid(shapes_rng *rng) {
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_random_solid(&mesh, rng, shapes_uniform(rng, 0.1, 0.4));
  double x = shapes_uniform(rng, -0.2, 0.2);
  double y = shapes_uniform(rng, -0.2, 0.2);
  shapes_place(&mesh, 0, NULL, x, y, 0.1);  // off its origin, as real meshes are
  return build(&mesh);
}
// A walk of `count` poses near the origin: steps of a few centimetres, and up to `turn` radians
// each.
static void random_walk(shapes_rng *rng, oracle_pose *poses, size_t count, double step,
                        double turn) {
  poses[0] = random_pose(rng, 0.3);
  for (size_t i = 1; i < count; i++) {
    double axis[3], q[4];
    shapes_direction(rng, axis);
    oracle_axis_angle(axis, shapes_uniform(rng, 0, turn), q);
    poses[i] = poses[i - 1];
    oracle_quat_mul(q, poses[i - 1].rotation, poses[i].rotation);
    oracle_quat_normalize(poses[i].rotation);
    for (int k = 0; k < 3; k++) poses[i].position[k] += step * shapes_normal(rng);
  }
}
static double volume(const shapes_mesh *mesh) {
  double sum = 0;
  for (size_t i = 0; i < mesh->triangles; i++) {
    const double *p[3];
    double c[3];
    for (size_t k = 0; k < 3; k++) p[k] = mesh->positions + 3 * mesh->indices[3 * i + k];
    oracle_cross(p[1], p[2], c);
    sum += oracle_dot(p[0], c) / 6;
  }
  return sum;
}

// ------------------------------------------------------------------------------------------ shapes

static void oracle_shapes_are_closed_and_outward(void) {
  shapes_rng rng = {1};
  for (int i = 0; i < 400; i++) {
    shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
    if (i % 2)
      shapes_random_solid(&mesh, &rng, 0.3);
    else
      shapes_random_hollow(&mesh, &rng, i / 2 % SHAPES_HOLLOWS, 0.3);
    double low[3], high[3];
    shapes_bounds(&mesh, low, high);
    CHECK(oracle_is_closed(mesh.positions, mesh.vertices, mesh.indices, mesh.triangles));
    CHECK_GE(volume(&mesh), 1e-6);
    CHECK_NEAR(fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]), 0.3, 1e-12);
    mesh.triangles--;  // the test must be able to say no
    CHECK(!oracle_is_closed(mesh.positions, mesh.vertices, mesh.indices, mesh.triangles));
    shapes_free(&mesh);
  }
}
static void oracle_shapes_are_reproducible(void) {
  shapes_mesh a = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_mesh b = a;
  shapes_rng rng_a = {7};
  shapes_rng rng_b = {7};
  shapes_random_solid(&a, &rng_a, 0.3);
  shapes_random_solid(&b, &rng_b, 0.3);
  CHECK_EQ(a.vertices, b.vertices);
  CHECK(a.vertices == b.vertices &&
        !memcmp(a.positions, b.positions, 3 * a.vertices * sizeof(double)));
  shapes_free(&a);
  shapes_free(&b);
}
static void oracle_shapes_have_the_volumes_of_textbooks(void) {
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_box(&mesh, 1, 2, 3, 3);
  CHECK_NEAR(volume(&mesh), 6, 1e-12);
  shapes_free(&mesh);
  shapes_cylinder(&mesh, 1, 2, 256);
  CHECK_NEAR(volume(&mesh), 2 * SHAPES_PI, 1e-3);
  shapes_free(&mesh);
  shapes_torus(&mesh, 1, 0.25, 256, 64);
  CHECK_NEAR(volume(&mesh), 2 * SHAPES_PI * SHAPES_PI / 16, 3e-3);
  shapes_free(&mesh);
  shapes_slot(&mesh, 1, 1, 1, 0.5, 0.5);
  CHECK_NEAR(volume(&mesh), 0.75, 1e-12);
  shapes_free(&mesh);
  double circle[90][3];  // a torus again, as a tube along a closed curve
  for (int i = 0; i < 90; i++) {
    circle[i][0] = cos(SHAPES_PI * i / 45);
    circle[i][1] = sin(SHAPES_PI * i / 45);
    circle[i][2] = 0;
  }
  shapes_tube(&mesh, (const double(*)[3])circle, 90, 0.25, 60, 1);
  CHECK_NEAR(volume(&mesh), 2 * SHAPES_PI * SHAPES_PI / 16, 6e-3);
  shapes_free(&mesh);
}

// --------------------------------------------------------------------------------------- distances

static oracle_triangle random_triangle(shapes_rng *rng, double offset) {
  oracle_triangle t;
  double stretch = exp(shapes_uniform(rng, -6, 0));  // slivers too
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      t.v[i][k] = offset + (k == 2 ? stretch : 1) * shapes_uniform(rng, -1, 1);
  oracle_triangle_normal(&t);
  return t;
}
static void on_triangle(const oracle_triangle *t, double u, double v, double *out) {
  for (int k = 0; k < 3; k++)
    out[k] = t->v[0][k] + u * (t->v[1][k] - t->v[0][k]) + v * (t->v[2][k] - t->v[0][k]);
}
// The least distance of sampled points is never below the answer, and at most half a grid cell's
// diagonals above it.
static void oracle_triangles_agree_with_sampling(void) {
  enum { N = 24 };
  shapes_rng rng = {2};
  int touching = 0;
  for (int trial = 0; trial < 300; trial++) {
    oracle_triangle a = random_triangle(&rng, 0);
    oracle_triangle b = random_triangle(&rng, shapes_uniform(&rng, 0, 1.2));
    double x[3];
    double y[3];
    double d[3];
    double least = DBL_MAX;
    double exact = sqrt(oracle_triangles(&a, &b, DBL_MAX, x, y));
    for (int i = 0; i < (N + 1) * (N + 1); i++)
      for (int j = 0; j < (N + 1) * (N + 1); j++) {
        double p[3], q[3];
        if (i / (N + 1) + i % (N + 1) > N || j / (N + 1) + j % (N + 1) > N) continue;
        on_triangle(&a, (double)(i / (N + 1)) / N, (double)(i % (N + 1)) / N, p);
        on_triangle(&b, (double)(j / (N + 1)) / N, (double)(j % (N + 1)) / N, q);
        oracle_sub(p, q, d);
        least = fmin(least, oracle_dot(d, d));
      }
    CHECK_GE(sqrt(least), exact - 1e-12);
    CHECK_LE(sqrt(least), exact + 2 * 3.5 / N);
    oracle_sub(x, y, d);
    CHECK_NEAR(oracle_length(d), exact, 1e-12);
    touching += exact <= 0;
    CHECK_NEAR(sqrt(oracle_triangles(&b, &a, DBL_MAX, x, y)), exact, 1e-9);  // symmetric
    CHECK_GE(oracle_triangles(&a, &b, exact * exact / 2, x, y), exact * exact / 2);
  }
  CHECK_GE(touching, 10);
  CHECK_LE(touching, 290);
}
static void oracle_triangles_of_no_area(void) {
  oracle_triangle needle = {{{0, 0, 1}, {1, 0, 1}, {0.5, 0, 1}}, {0, 0, 0}};
  oracle_triangle point = {{{0.2, 0.2, 3}, {0.2, 0.2, 3}, {0.2, 0.2, 3}}, {0, 0, 0}};
  oracle_triangle floor = {{{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}, {0, 0, 0}};
  oracle_triangle through = {{{0, 0, -1}, {0, 0, 1}, {0, 0, 0.5}}, {0, 0, 0}};
  double x[3], y[3];
  oracle_triangle_normal(&needle);
  oracle_triangle_normal(&point);
  oracle_triangle_normal(&floor);
  oracle_triangle_normal(&through);
  CHECK_NEAR(sqrt(oracle_triangles(&floor, &needle, DBL_MAX, x, y)), 1, 1e-12);
  CHECK_NEAR(sqrt(oracle_triangles(&floor, &point, DBL_MAX, x, y)), 3, 1e-12);
  CHECK_NEAR(sqrt(oracle_triangles(&needle, &point, DBL_MAX, x, y)), sqrt(0.04 + 4), 1e-12);
  CHECK_EQ(oracle_triangles(&floor, &through, DBL_MAX, x, y), 0);
  CHECK_EQ(oracle_triangles(&through, &floor, DBL_MAX, x, y), 0);
  CHECK_NEAR(sqrt(oracle_triangles(&floor, &floor, DBL_MAX, x, y)), 0, 1e-12);  // coplanar
}
static void oracle_distance_agrees_with_brute_force(void) {
  shapes_rng rng = {3};
  for (int trial = 0; trial < 20; trial++) {
    oracle_mesh a = random_solid(&rng);
    oracle_mesh b = random_solid(&rng);
    oracle_pose pa = random_pose(&rng, 0.2);
    oracle_pose pb = random_pose(&rng, 0.2);
    double x[3];
    double y[3];
    double d[3];
    double least = DBL_MAX;
    double fast = oracle_distance(&a, &pa, &b, &pb, x, y);
    oracle_sub(x, y, d);
    CHECK_NEAR(oracle_length(d), fast, 1e-12);
    for (size_t i = 0; i < a.triangle_count; i++)
      for (size_t j = 0; j < b.triangle_count; j++) {
        oracle_triangle u, v;
        for (int k = 0; k < 3; k++) {
          oracle_transform(&pa, a.triangles[i].v[k], u.v[k]);
          oracle_transform(&pb, b.triangles[j].v[k], v.v[k]);
        }
        oracle_triangle_normal(&u);
        oracle_triangle_normal(&v);
        least = fmin(least, oracle_triangles(&u, &v, least, x, y));
      }
    CHECK_NEAR(fast, sqrt(least), 1e-9);
    oracle_mesh_free(&a);
    oracle_mesh_free(&b);
  }
}

// ----------------------------------------------------------------------------------------- motions

// Two spheres in passing. The meshes are inscribed: their separation exceeds that of the spheres,
// by the sagitta at most.
static void oracle_sphere_past_sphere(void) {
  oracle_mesh a = sphere(0.1, 96);
  oracle_mesh b = sphere(0.15, 96);
  oracle_pose poses[2];
  oracle_pose here = identity;
  poses[0] = at(-0.5, 0.3, 0.02);
  poses[1] = at(0.5, 0.3, 0.02);
  oracle_result r = oracle_sweep(&a, poses, 2, &b, &here, NULL);
  double exact = sqrt(0.3 * 0.3 + 0.02 * 0.02) - 0.25;
  double sagitta = 2 * 0.25 * (1 - cos(SHAPES_PI / 96));
  CHECK_EQ(r.status, ORACLE_FREE);
  CHECK_GE(r.distance, exact);
  CHECK_LE(r.distance, exact + sagitta + 1e-4);
  CHECK_NEAR(r.time, 0.5, 0.03);
  poses[0].position[1] = poses[1].position[1] = 0.24;
  CHECK_EQ(oracle_sweep(&a, poses, 2, &b, &here, NULL).status, ORACLE_COLLIDES);
  oracle_mesh_free(&a);
  oracle_mesh_free(&b);
}
static void oracle_box_through_wall(void) {
  oracle_mesh a = box(0.1, 0.1, 0.1);
  oracle_mesh wall = box(0.02, 1, 1);
  oracle_pose poses[2];
  oracle_pose here = at(0.3, 0, 0);
  oracle_options first = {0, 0, 1, 0};
  poses[0] = at(0, 0.013, 0.007);
  poses[1] = at(1, 0.013, 0.007);
  oracle_result r = oracle_sweep(&a, poses, 2, &wall, &here, &first);
  CHECK_EQ(r.status, ORACLE_COLLIDES);
  CHECK_NEAR(r.time, 0.3 - 0.01 - 0.05, 1e-4);
  CHECK_NEAR(r.on_fixed[0], 0.29, 1e-4);
  here = at(-1, 0, 0);  // a wall that it leaves behind
  r = oracle_sweep(&a, poses, 2, &wall, &here, NULL);
  CHECK_EQ(r.status, ORACLE_FREE);
  CHECK_NEAR(r.distance, 1 - 0.05 - 0.01, 1e-4);
  CHECK_NEAR(r.time, 0, 1e-4);
  oracle_mesh_free(&a);
  oracle_mesh_free(&wall);
}
// Sliding along a wall keeps the distance constant, the hardest case for branch and bound; and the
// tolerance's edges.
static void oracle_box_slides_along_wall(void) {
  oracle_mesh a = box(0.1, 0.1, 0.1);
  oracle_mesh wall = box(0.02, 1, 1);
  oracle_pose poses[3];
  oracle_pose here = identity;
  double gaps[4] = {5e-3, 2e-4, 5e-5, -2e-4};
  oracle_status expected[4] = {ORACLE_FREE, ORACLE_FREE, ORACLE_UNDECIDED, ORACLE_COLLIDES};
  for (int i = 0; i < 4; i++) {
    double x = 0.06 + gaps[i];
    poses[0] = at(x, -0.3, 0.1);
    poses[1] = at(x, -0.1, 0);
    poses[2] = at(x, 0.2, 0);
    oracle_result r = oracle_sweep(&a, poses, 3, &wall, &here, NULL);
    CHECK_EQ(r.status, expected[i]);
    CHECK_NEAR(r.distance, fmax(gaps[i], 0), 1e-9);
  }
  oracle_mesh_free(&a);
  oracle_mesh_free(&wall);
}
// A rod turns a quarter about z; its corner passes the wall when it points along x.
static void oracle_rod_sweeps_past_wall(void) {
  oracle_mesh rod = box(0.4, 0.02, 0.02);
  oracle_mesh wall = box(0.02, 1, 1);
  oracle_pose poses[2];
  oracle_pose here = identity;
  double reach = sqrt(0.2 * 0.2 + 0.01 * 0.01);
  double corner = atan2(0.01, 0.2);
  double z[3] = {0, 0, 1};
  poses[0] = poses[1] = identity;
  oracle_axis_angle(z, -corner - 0.3, poses[0].rotation);
  oracle_axis_angle(z, -corner + 0.9, poses[1].rotation);
  here = at(reach + 0.01 + 0.004, 0, 0);
  oracle_result r = oracle_sweep(&rod, poses, 2, &wall, &here, NULL);
  CHECK_EQ(r.status, ORACLE_FREE);
  CHECK_GE(r.distance, 0.004 - 1e-9);
  CHECK_LE(r.distance, 0.004 + 1e-4);
  here = at(reach + 0.01 - 0.001, 0, 0);
  oracle_options first = {0, 0, 1, 0};
  r = oracle_sweep(&rod, poses, 2, &wall, &here, &first);
  CHECK_EQ(r.status, ORACLE_COLLIDES);
  // The corner at angle -a reaches the wall when reach cos(a) = reach - 0.001.
  CHECK_NEAR(r.time, (0.3 - acos(1 - 0.001 / reach)) / 1.2, 2e-3);
  // the same turn: the shorter arc
  for (int k = 0; k < 4; k++) poses[1].rotation[k] = -poses[1].rotation[k];
  CHECK_NEAR(oracle_sweep(&rod, poses, 2, &wall, &here, &first).time, r.time, 1e-9);
  oracle_mesh_free(&rod);
  oracle_mesh_free(&wall);
}
// No point of the body moves farther than u says.
static void oracle_path_bound_holds(void) {
  shapes_rng rng = {4};
  double tightest = 0;
  for (int trial = 0; trial < 200; trial++) {
    oracle_mesh a = random_solid(&rng);
    oracle_pose poses[5];
    oracle_motion motion;
    random_walk(&rng, poses, 5, 0.1, trial % 2 ? 0.3 : 3.1);
    CHECK(oracle_motion_init(&motion, &a, poses, 5));
    for (int i = 0; i < 300; i++) {
      double u0 = shapes_uniform(&rng, 0, motion.u[4]);
      double u1 = shapes_uniform(&rng, 0, motion.u[4]);
      double x[3];
      double y[3];
      double d[3];
      const double *v = a.triangles[shapes_next(&rng) % a.triangle_count].v[0];
      oracle_pose p0 = oracle_pose_at(poses, 5, oracle_motion_time(&motion, u0));
      oracle_pose p1 = oracle_pose_at(poses, 5, oracle_motion_time(&motion, u1));
      oracle_transform(&p0, v, x);
      oracle_transform(&p1, v, y);
      oracle_sub(x, y, d);
      CHECK_LE(oracle_length(d), fabs(u1 - u0) + 1e-12);
      if (fabs(u1 - u0) > 1e-3) tightest = fmax(tightest, oracle_length(d) / fabs(u1 - u0));
    }
    oracle_motion_free(&motion);
    oracle_mesh_free(&a);
  }
  CHECK_GE(tightest, 0.9);  // and it is not slack throughout
}
static void oracle_sweep_agrees_with_dense_sampling(void) {
  enum { DENSE = 800 };
  shapes_rng rng = {5};
  int seen[2] = {0, 0};
  for (int trial = 0; trial < 40; trial++) {
    oracle_mesh a = random_solid(&rng);
    oracle_mesh b = random_solid(&rng);
    oracle_pose poses[9];
    oracle_pose here = random_pose(&rng, 0.2);
    random_walk(&rng, poses, 9, 0.04, 0.5);
    if (trial % 2) {
      here.position[0] = poses[8].position[0];
      here.position[1] = poses[8].position[1];
    }
    oracle_options first = {0, 0, 1, 1};
    oracle_options decide = {0, 2e-3, 0, 1};
    oracle_result r = oracle_sweep(&a, poses, 9, &b, &here, &first);
    oracle_result quick = oracle_sweep(&a, poses, 9, &b, &here, &decide);
    oracle_search search;
    oracle_search_begin(&search, &b, &a);
    double least = DBL_MAX;
    double least_before = DBL_MAX;
    for (int i = 0; i <= DENSE; i++) {
      double t = (double)i / DENSE;
      oracle_pose pose = oracle_pose_at(poses, 9, t);
      double d = oracle_search_run(&search, &here, &pose, least);
      least = fmin(least, d);
      if (t < r.time) least_before = least;
    }
    seen[r.status == ORACLE_COLLIDES]++;
    CHECK_GE(least, r.lower - 1e-9);
    CHECK_LE(r.lower, r.distance + 1e-12);
    CHECK_GE(r.lower, r.distance - 1e-4 - 1e-12);
    if (r.status == ORACLE_COLLIDES) {
      CHECK_GE(least_before, 1e-9);  // nothing touches before the first contact
      oracle_pose pose = oracle_pose_at(poses, 9, r.time);
      CHECK_LE(oracle_distance(&a, &pose, &b, &here, NULL, NULL), 0.5e-4 + 1e-9);
      CHECK_EQ(quick.status, ORACLE_COLLIDES);
    } else {
      oracle_pose pose = oracle_pose_at(poses, 9, r.time);
      double x[3], y[3], d[3];
      CHECK_LE(r.distance, least + 1e-4 + 1e-9);
      CHECK_NEAR(oracle_distance(&a, &pose, &b, &here, x, y), r.distance, 1e-9);
      oracle_sub(r.on_moving, r.on_fixed, d);
      CHECK_NEAR(oracle_length(d), r.distance, 1e-9);
      CHECK_EQ(quick.status, r.status);
      if (quick.status == ORACLE_FREE) CHECK_GE(quick.lower, fmin(2e-3, r.distance - 1e-4) - 1e-9);
    }
    oracle_mesh_free(&a);
    oracle_mesh_free(&b);
  }
  CHECK_GE(seen[0], 8);
  CHECK_GE(seen[1], 8);
}
static void oracle_is_invariant_under_rigid_motion(void) {
  shapes_rng rng = {6};
  for (int trial = 0; trial < 20; trial++) {
    oracle_mesh a = random_solid(&rng);
    oracle_mesh b = random_solid(&rng);
    oracle_pose poses[5];
    oracle_pose moved[5];
    oracle_pose here = random_pose(&rng, 0.4);
    oracle_pose all = random_pose(&rng, 10);
    oracle_pose there = oracle_compose(&all, &here);
    random_walk(&rng, poses, 5, 0.05, 0.5);
    for (int i = 0; i < 5; i++) moved[i] = oracle_compose(&all, &poses[i]);
    oracle_result r = oracle_sweep(&a, poses, 5, &b, &here, NULL);
    oracle_result s = oracle_sweep(&a, moved, 5, &b, &there, NULL);
    CHECK_EQ(r.status, s.status);
    CHECK_NEAR(r.distance, s.distance, 2e-5);
    oracle_mesh_free(&a);
    oracle_mesh_free(&b);
  }
}
static void oracle_single_pose(void) {
  oracle_mesh a = box(0.1, 0.1, 0.1);
  oracle_mesh b = box(0.1, 0.1, 0.1);
  oracle_pose here = identity;
  oracle_pose there = at(0.15, 0, 0);
  oracle_result r = oracle_sweep(&a, &there, 1, &b, &here, NULL);
  CHECK_EQ(r.status, ORACLE_FREE);
  CHECK_NEAR(r.distance, 0.05, 1e-12);
  CHECK_NEAR(r.lower, 0.05, 1e-12);
  there = at(0.09, 0.01, 0.02);
  CHECK_EQ(oracle_sweep(&a, &there, 1, &b, &here, NULL).status, ORACLE_COLLIDES);
  oracle_mesh_free(&a);
  oracle_mesh_free(&b);
}

// ------------------------------------------------------------------------------------- containment

static void oracle_winding_numbers(void) {
  oracle_mesh cube = box(1, 1, 1);
  double center[3] = {0.1, -0.2, 0.3};
  double outside[3] = {0.7, 0, 0};
  double hole[3] = {0, 0, 0};
  double tube[3] = {0.4, 0, 0};
  CHECK_NEAR(oracle_winding(&cube, center), 1, 1e-12);
  CHECK_NEAR(oracle_winding(&cube, outside), 0, 1e-12);
  cube.triangle_count = 0;
  for (size_t i = 0; i < 2 * 4 * 6;
       i++)  // without the face z = 0.5 a sixth of the solid angle is missing at the centre
    if (cube.triangles[i].normal[2] < 0.5)
      cube.triangles[cube.triangle_count++] = cube.triangles[i];
  CHECK_NEAR(oracle_winding(&cube, hole), 5.0 / 6, 1e-12);
  oracle_mesh_free(&cube);
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_torus(&mesh, 0.4, 0.1, 24, 12);
  oracle_mesh torus = build(&mesh);
  CHECK_NEAR(oracle_winding(&torus, hole), 0, 1e-12);
  CHECK_NEAR(oracle_winding(&torus, tube), 1, 1e-12);
  oracle_mesh_free(&torus);
  shapes_shell(&mesh, 1, 1, 1, 0.1, 1, 32);
  oracle_mesh shell = build(&mesh);
  CHECK_NEAR(oracle_winding(&shell, hole), 0, 1e-12);
  CHECK_NEAR(oracle_winding(&shell, (tube[0] = 0.45, tube)), 1, 1e-12);
  oracle_mesh_free(&shell);
}
static void oracle_containment(void) {
  oracle_mesh small = box(0.05, 0.05, 0.05);
  oracle_mesh large = box(0.4, 0.4, 0.4);
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  shapes_shell(&mesh, 0.4, 0.4, 0.4, 0.05, 0, 8);
  oracle_mesh shell = build(&mesh);
  shapes_box_at(&mesh, 5, 0, 0, 0.05, 0.05, 0.05);
  shapes_box_at(&mesh, 0, 0, 0, 0.05, 0.05, 0.05);
  oracle_mesh two = build(&mesh);  // only its second part is inside
  oracle_pose poses[2];
  oracle_pose here = identity;
  poses[0] = at(0, 0, 0);
  poses[1] = at(0.1, 0, 0);
  CHECK_EQ(oracle_sweep(&small, poses, 2, &large, &here, NULL).status, ORACLE_INSIDE);
  CHECK_EQ(oracle_sweep(&large, poses, 2, &small, &here, NULL).status, ORACLE_INSIDE);
  CHECK_EQ(oracle_sweep(&small, poses, 2, &shell, &here, NULL).status, ORACLE_FREE);
  CHECK_EQ(oracle_sweep(&two, poses, 2, &large, &here, NULL).status, ORACLE_INSIDE);
  CHECK_EQ(two.seed_count, 2);
  poses[1] = at(0.3, 0, 0);  // breaks out
  CHECK_EQ(oracle_sweep(&small, poses, 2, &large, &here, NULL).status, ORACLE_COLLIDES);
  oracle_mesh_free(&small);
  oracle_mesh_free(&large);
  oracle_mesh_free(&shell);
  oracle_mesh_free(&two);
}

// ------------------------------------------------------------------------------------------ libccd
#ifdef HAVE_LIBCCD

// libccd only says whether two convex bodies intersect. Grown by a radius, they intersect as soon
// as the radius reaches the distance: which checks the distance too.
typedef struct convex {
  const oracle_mesh *mesh;
  oracle_pose pose;
  double grown;
} convex;

static void convex_support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out) {
  const convex *c = (const convex *)object;
  double best = -DBL_MAX;
  double m[9];
  double d[3];
  double local[3];
  for (int k = 0; k < 3; k++) d[k] = (double)direction->v[k];
  oracle_matrix(c->pose.rotation, m);
  oracle_rotate_back(m, d, local);
  const double *farthest = c->mesh->triangles[0].v[0];
  for (size_t i = 0; i < 3 * c->mesh->triangle_count; i++) {
    const double *v = c->mesh->triangles[i / 3].v[i % 3];
    if (oracle_dot(v, local) > best) {
      best = oracle_dot(v, local);
      farthest = v;
    }
  }
  oracle_transform(&c->pose, farthest, d);
  double norm = sqrt(oracle_dot(local, local));
  for (int k = 0; k < 3; k++)
    out->v[k] = (ccd_real_t)(d[k] + c->grown * (double)direction->v[k] / (norm > 0 ? norm : 1));
}
static oracle_mesh random_convex(shapes_rng *rng) {
  shapes_mesh mesh = {NULL, NULL, 0, 0, 0, 0, 0};
  double a = shapes_uniform(rng, 0.1, 1);
  double b = shapes_uniform(rng, 0.1, 1);
  double c = shapes_uniform(rng, 0.05, 1);
  switch (shapes_pick(rng, 5)) {
    case 0:
      shapes_box(&mesh, a, b, c, 1);
      break;
    case 1:
      shapes_cylinder(&mesh, a / 2, b, 12);
      break;
    case 2:
      shapes_cone(&mesh, a / 2, 0, b, 10);
      break;
    case 3:
      shapes_ellipsoid(&mesh, a / 2, b / 2, c / 2, 12);
      break;
    default:
      shapes_capsule(&mesh, a / 4, b, 12);
      break;
  }
  return build(&mesh);
}
static void oracle_agrees_with_libccd(void) {
  shapes_rng rng = {8};
  int apart = 0;
  int touching = 0;
  int inside = 0;
  for (int trial = 0; trial < 600; trial++) {
    oracle_mesh ma = random_convex(&rng);
    oracle_mesh mb = random_convex(&rng);
    convex a = {&ma, random_pose(&rng, 0.5), 0};
    convex b = {&mb, random_pose(&rng, 0.5), 0};
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = convex_support;
    ccd.support2 = convex_support;
    ccd.max_iterations = 500;
    double exact = oracle_distance(&ma, &a.pose, &mb, &b.pose, NULL, NULL);
    double contained =
        fmax(oracle_inside(&ma, &a.pose, &mb, &b.pose), oracle_inside(&mb, &b.pose, &ma, &a.pose));
    int hit = exact <= 0 || contained > 0.5;
    if (hit || exact > 1e-4) CHECK_EQ(ccdGJKIntersect(&a, &b, &ccd), hit);
    if (!hit && exact > 1e-3) {
      a.grown = exact - 1e-4;
      CHECK(!ccdGJKIntersect(&a, &b, &ccd));
      // libccd 2.1 may still say no at 1e-4, and yes with the bodies swapped
      a.grown = exact + 3e-4;
      CHECK(ccdGJKIntersect(&a, &b, &ccd));
    }
    hit ? (void)(exact > 0 ? inside++ : touching++) : (void)apart++;
    oracle_mesh_free(&ma);
    oracle_mesh_free(&mb);
  }
  CHECK_GE(apart, 100);
  CHECK_GE(touching, 100);
  CHECK_GE(inside, 1);
}
#endif

void test_oracle(void) {
  RUN(oracle_shapes_are_closed_and_outward);
  RUN(oracle_shapes_are_reproducible);
  RUN(oracle_shapes_have_the_volumes_of_textbooks);
  RUN(oracle_triangles_agree_with_sampling);
  RUN(oracle_triangles_of_no_area);
  RUN(oracle_distance_agrees_with_brute_force);
  RUN(oracle_sphere_past_sphere);
  RUN(oracle_box_through_wall);
  RUN(oracle_box_slides_along_wall);
  RUN(oracle_rod_sweeps_past_wall);
  RUN(oracle_path_bound_holds);
  RUN(oracle_sweep_agrees_with_dense_sampling);
  RUN(oracle_is_invariant_under_rigid_motion);
  RUN(oracle_single_pose);
  RUN(oracle_winding_numbers);
  RUN(oracle_containment);
#ifdef HAVE_LIBCCD
  RUN(oracle_agrees_with_libccd);
#endif
}

CHECK_ALONE(test_oracle)
