// Contacts of bodies at rest: are they on both surfaces, and is none missing? Against distances in
// double, by the oracle.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "../examples/scenery/level.h"
#include "../examples/scenery/oracle.h"
#include "body_of.h"
#include "check.h"

void test_contacts(void);

enum { MOST = NSVCD_MAX_SIDES * NSVCD_MAX_CONTACTS };

// A body, and its mesh, or skeleton, as the oracle has it: scaled.
typedef struct thing {
  const nsvcd_body *body;
  oracle_mesh mesh;
  double round, scale;
  // how far the library's triangles may be off
  double off;
} thing;

// Takes the shape.
static thing thing_of(shapes_mesh *shape, double round, double scale) {
  thing out;
  nsvcd_encode_options options;
  memset(&out, 0, sizeof out);
  memset(&options, 0, sizeof options);
  options.convex_radius = (float)round;
  out.body = body_of(shape, &options);
  out.round = (double)options.convex_radius * scale;
  out.scale = scale;
  out.off = fabs(scale - 1) > 0 ? 1e-5 * scale * (double)nsvcd_body_describe(out.body).extent : 0;
  for (size_t k = 0; k < 3 * shape->vertices; k++)
    shape->positions[k] = (double)(float)shape->positions[k];
  if (!oracle_mesh_init(&out.mesh, shape->positions, shape->vertices, shape->indices,
                        shape->triangles, (double)(float)scale))
    exit(1);
  shapes_free(shape);
  return out;
}
static thing thing_box(double x, double y, double z, int cuts, double scale) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, x, y, z, cuts);
  return thing_of(&shape, 0, scale);
}
// A sphere, or a capsule along x.
static thing thing_round(double length, double round) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  const uint32_t a = shapes_vertex(&shape, -length / 2, 0, 0);
  const uint32_t b = length > 0 ? shapes_vertex(&shape, length / 2, 0, 0) : a;
  shapes_triangle(&shape, a, b, b);
  return thing_of(&shape, round, 1);
}
static void thing_free(thing *t) {
  nsvcd_body_free(t->body, NULL);
  oracle_mesh_free(&t->mesh);
}

static void *workspace(size_t *size) {
  static void *memory;
  *size = nsvcd_sweep_workspace_size(NULL);
  if (!memory) memory = malloc(*size);
  if (!memory) exit(1);
  memset(memory, 0x5a, *size);
  return memory;
}

static nsvcd_question question_of_things(const thing *a, const nsvcd_pose *at_a, const thing *b,
                                         const nsvcd_pose *at_b, double margin) {
  nsvcd_question q;
  memset(&q, 0, sizeof q);
  q.a.body = a->body;
  q.a.poses = at_a;
  q.a.count = at_a != NULL;
  q.a.scale = (float)a->scale;
  q.b.body = b->body;
  q.b.poses = at_b;
  q.b.count = at_b != NULL;
  q.b.scale = (float)b->scale;
  q.clearance = (float)margin;
  return q;
}

static nsvcd_pose pose_of(double x, double y, double z, const double *rotation) {
  nsvcd_pose out = {{(float)x, (float)y, (float)z}, {0, 0, 0, 1}};
  for (int k = 0; k < 4 && rotation; k++) out.rotation[k] = (float)rotation[k];
  return out;
}
static oracle_pose seen(const nsvcd_pose *pose) {
  oracle_pose out = {{0, 0, 0}, {0, 0, 0, 1}};
  for (int k = 0; k < 3 && pose; k++) out.position[k] = (double)pose->position[k];
  for (int k = 0; k < 4 && pose; k++) out.rotation[k] = (double)pose->rotation[k];
  oracle_quat_normalize(out.rotation);
  return out;
}

// ---- what the oracle says

static double dot_f(const float *a, const double *b) {
  return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

static oracle_triangle placed(const oracle_triangle *t, const oracle_pose *at) {
  oracle_triangle out;
  for (int k = 0; k < 3; k++) oracle_transform(at, t->v[k], out.v[k]);
  oracle_triangle_normal(&out);
  return out;
}
static oracle_triangle point_as_triangle(const double *x) {
  oracle_triangle out;
  for (int k = 0; k < 3; k++) memcpy(out.v[k], x, sizeof out.v[k]);
  oracle_triangle_normal(&out);
  return out;
}
static double triangles_apart(const oracle_triangle *a, const oracle_triangle *b, double *on_a,
                              double *on_b) {
  double x[3], y[3];
  return sqrt(oracle_triangles(a, b, 1e30, on_a ? on_a : x, on_b ? on_b : y));
}

// Triangles of a mesh, in the world, that come within a distance of a ball.
static size_t triangles_near(const thing *t, const oracle_pose *at, const double *centre,
                             double reach, oracle_triangle **out) {
  size_t count = 0;
  *out = (oracle_triangle *)malloc(t->mesh.triangle_count * sizeof **out);
  if (!*out) exit(1);
  const oracle_triangle ball = point_as_triangle(centre);
  for (size_t n = 0; n < t->mesh.triangle_count; n++) {
    const oracle_triangle here = placed(&t->mesh.triangles[n], at);
    if (triangles_apart(&here, &ball, NULL, NULL) <= reach) (*out)[count++] = here;
  }
  return count;
}
static double nearest_of(const oracle_triangle *all, size_t count, const oracle_triangle *to) {
  double least = HUGE_VAL;
  for (size_t n = 0; n < count; n++) least = fmin(least, triangles_apart(&all[n], to, NULL, NULL));
  return least;
}

// What is checked of a set of contacts, and of what lies about them.
typedef struct contacts_of {
  nsvcd_contact at[MOST];
  size_t count;
  int partial, places;  // at how many places the distance is least of all about it
} contacts_of;

// Each place where the distance of the surfaces is least, of all about it, within the margin: is
// there a contact that is as near, in about that direction? Directions of one side differ by 37
// degrees from that of its nearest place, and so do its contacts' normals.
static int least_places(const oracle_triangle *as, size_t count_a, const oracle_triangle *bs,
                        size_t count_b, double radii, double margin, double tolerance,
                        const contacts_of *found) {
  int places = 0;
  for (size_t i = 0; i < count_a; i++) {
    for (size_t j = 0; j < count_b; j++) {
      double x[3], y[3], n[3];
      const double d = triangles_apart(&as[i], &bs[j], x, y);
      int is_least = d - radii < margin - 2 * tolerance - 1e-6 && d - radii > 1e-6;
      const oracle_triangle on_a = point_as_triangle(x);
      const oracle_triangle on_b = point_as_triangle(y);
      for (size_t k = 0; k < count_a && is_least; k++) {
        if (triangles_apart(&as[k], &on_a, NULL, NULL) > 1e-9) continue;
        is_least &= triangles_apart(&as[k], &bs[j], NULL, NULL) > d - 1e-10;
      }
      for (size_t k = 0; k < count_b && is_least; k++) {
        if (triangles_apart(&bs[k], &on_b, NULL, NULL) > 1e-9) continue;
        is_least &= triangles_apart(&as[i], &bs[k], NULL, NULL) > d - 1e-10;
      }
      if (!is_least) continue;
      places++;
      int has = 0;
      for (int k = 0; k < 3; k++) n[k] = (x[k] - y[k]) / d;
      for (size_t c = 0; c < found->count; c++)
        has |= dot_f(found->at[c].normal, n) > 0.27 &&
               (double)found->at[c].gap <= d - radii + 1e-6 + 2 * tolerance;
      CHECK(has);
    }
  }
  return places;
}

// Are the contacts where the surfaces are, and are the bodies as near as they say? Returns at how
// many places they are.
static int refute(const thing *a, const nsvcd_pose *at_a, const thing *b, const nsvcd_pose *at_b,
                  double margin, const contacts_of *found) {
  const oracle_pose pose_a = seen(at_a);
  const oracle_pose pose_b = seen(at_b);
  const double radii = a->round + b->round;
  const double apart = oracle_distance(&a->mesh, &pose_a, &b->mesh, &pose_b, NULL, NULL) - radii;
  const double far_off = oracle_length(pose_a.position) + oracle_length(pose_b.position);
  const double tolerance = 2e-6 + a->off + b->off + 2e-7 * far_off;
  oracle_triangle *near_a, *near_b;
  double centre[3];
  const thing *small = a->mesh.radius < b->mesh.radius ? a : b;
  oracle_transform(small == a ? &pose_a : &pose_b, small->mesh.center, centre);
  const double reach = small->mesh.radius + radii + 2 * margin;
  const size_t count_a = triangles_near(a, &pose_a, centre, reach, &near_a);
  const size_t count_b = triangles_near(b, &pose_b, centre, reach, &near_b);
  double least = HUGE_VAL;
  if (apart > margin + tolerance) CHECK_EQ(found->count, 0);
  if (apart < margin - tolerance) CHECK_GE(found->count, 1);
  CHECK_LE(found->count, MOST);
  for (size_t n = 0; n < found->count; n++) {
    const nsvcd_contact *c = &found->at[n];
    const double on_b[3] = {(double)c->point[0], (double)c->point[1], (double)c->point[2]};
    double on_a[3];
    for (int k = 0; k < 3; k++) on_a[k] = on_b[k] + (double)c->gap * (double)c->normal[k];
    const oracle_triangle at_b_point = point_as_triangle(on_b);
    const oracle_triangle at_a_point = point_as_triangle(on_a);
    const double gap = (double)c->gap;
    least = fmin(least, gap);
    CHECK(c->time >= 0 && c->time <= 0);
    CHECK_NEAR(dot_f(c->normal, on_a), dot_f(c->normal, on_b) + gap, 1e-5 * (1 + far_off));
    CHECK_LE(gap, margin + tolerance);
    CHECK_NEAR(nearest_of(near_b, count_b, &at_b_point), b->round, tolerance);
    CHECK_NEAR(nearest_of(near_a, count_a, &at_a_point), a->round, tolerance);
    // no farther than it says, and not much nearer: there may be another place beside it
    const double to_a = nearest_of(near_a, count_a, &at_b_point) - a->round;
    CHECK_LE(to_a, gap + tolerance);
    CHECK_GE(gap + tolerance, apart);
  }
  if (found->count > 0) CHECK_NEAR(least, fmax(apart, 0), fmax(1e-5, tolerance));
  const int places =
      least_places(near_a, count_a, near_b, count_b, radii, margin, tolerance, found);
  free(near_a);
  free(near_b);
  return places;
}

static contacts_of ask(const thing *a, const nsvcd_pose *at_a, const thing *b,
                       const nsvcd_pose *at_b, double margin) {
  contacts_of out;
  size_t size;
  void *memory = workspace(&size);
  const nsvcd_question q = question_of_things(a, at_a, b, at_b, margin);
  memset(&out, 0, sizeof out);
  const nsvcd_result result =
      nsvcd_contacts(&q, memory, size, out.at, MOST, &out.count, &out.partial);
  CHECK_EQ(result, NSVCD_OK);
  CHECK_EQ(out.partial, 0);
  out.places = refute(a, at_a, b, at_b, margin, &out);
  return out;
}

// Contacts with about this normal; NAN as gap: whatever it is.
static size_t count_along(const contacts_of *found, double x, double y, double z, double gap,
                          double tolerance) {
  const double n[3] = {x, y, z};
  size_t count = 0;
  for (size_t k = 0; k < found->count; k++) {
    if (dot_f(found->at[k].normal, n) < 1 - 1e-5) continue;
    CHECK_NEAR(found->at[k].gap, gap, tolerance);
    count++;
  }
  return count;
}

// ---- scenes

// A floor and two walls that meet at the origin, as one mesh: half as large if it is to be scaled.
static thing corner_of_a_room(double scale) {
  shapes_mesh shape;
  const double s = 1 / scale;
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, 0.45 * s, 0.45 * s, -0.05 * s, s, s, 0.1 * s);
  shapes_box_at(&shape, -0.05 * s, 0.5 * s, 0.45 * s, 0.1 * s, 1.1 * s, 1.1 * s);
  shapes_box_at(&shape, 0.5 * s, -0.05 * s, 0.45 * s, 1.1 * s, 0.1 * s, 1.1 * s);
  return thing_of(&shape, 0, scale);
}

// The pose of a body in a room that is posed itself.
static nsvcd_pose pose_in(const nsvcd_pose *room, double x, double y, double z) {
  const oracle_pose inner = {{x, y, z}, {0, 0, 0, 1}};
  const oracle_pose outer = seen(room);
  const oracle_pose both = oracle_compose(&outer, &inner);
  return pose_of(both.position[0], both.position[1], both.position[2], both.rotation);
}

static void a_box_in_a_corner_has_three_sides(void) {
  static const double gaps[3] = {2e-4, 5e-4, 9e-4};
  static const double scales[3] = {1, 2, 0.5};
  static const double away[3] = {0, 3, 400};
  shapes_rng rng = {5};
  for (int n = 0; n < 9; n++) {
    thing room = corner_of_a_room(scales[n % 3]);
    thing box =
        thing_box(0.2 / scales[n / 3], 0.3 / scales[n / 3], 0.1 / scales[n / 3], 2, scales[n / 3]);
    double q[4] = {0, 0, 0, 1};
    if (n > 0) shapes_quaternion(&rng, q);
    const double far_off = away[n % 3];
    const nsvcd_pose at = pose_of(far_off, -far_off, far_off, q);
    const nsvcd_pose in = pose_in(&at, 0.1 + gaps[0], 0.15 + gaps[1], 0.05 + gaps[2]);
    const double tolerance = 3e-6 + 3e-7 * far_off + room.off + box.off;
    for (int swapped = 0; swapped < 2; swapped++) {
      const contacts_of found =
          swapped ? ask(&room, &at, &box, &in, 1.5e-3) : ask(&box, &in, &room, &at, 1.5e-3);
      double m[9];
      const oracle_pose turned = seen(&at);
      oracle_matrix(turned.rotation, m);
      CHECK_EQ(found.count, 12);
      for (int k = 0; k < 3; k++) {
        const double side = swapped ? -1 : 1;
        CHECK_EQ(
            count_along(&found, side * m[k], side * m[3 + k], side * m[6 + k], gaps[k], tolerance),
            4);
      }
      for (size_t k = 1; k < found.count; k++)
        CHECK_LE(found.at[k - 1].gap, found.at[k].gap + (float)tolerance);
    }
    thing_free(&room);
    thing_free(&box);
  }
}

static void a_box_between_floor_and_ceiling_has_two_sides(void) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, 0, 0, -0.05, 1, 1, 0.1);
  shapes_box_at(&shape, 0, 0, 0.25, 1, 1, 0.1);
  thing room = thing_of(&shape, 0, 1);
  thing box = thing_box(0.1, 0.1, 0.199, 1, 1);
  const nsvcd_pose at = pose_of(0.1, 0.05, 0.0997, NULL);
  const contacts_of found = ask(&box, &at, &room, NULL, 1e-3);
  CHECK_EQ(found.count, 8);
  CHECK_EQ(count_along(&found, 0, 0, 1, 2e-4, 1e-6), 4);
  CHECK_EQ(count_along(&found, 0, 0, -1, 8e-4, 1e-6), 4);
  CHECK(found.at[0].normal[2] > 0);
  CHECK_EQ(ask(&box, &at, &room, NULL, 5e-4).count, 4);
  CHECK_EQ(ask(&box, &at, &room, NULL, 1e-4).count, 0);
  thing_free(&room);
  thing_free(&box);
}

// Floors of 40 x 40 squares, each two triangles.
static void inner_edges_of_a_floor_are_no_sides(void) {
  thing floor_of_many = thing_box(0.4, 0.4, 0.1, 40, 1);
  thing box = thing_box(0.03, 0.02, 0.01, 1, 1);
  thing ball = thing_round(0, 0.02);
  thing capsule = thing_round(0.05, 0.01);
  shapes_rng rng = {9};
  for (size_t n = 0; n < check_many(60); n++) {
    // the first is where an edge that leans over one of the floor's was taken for a corner
    const double x = n == 0 ? 0.015668728 : shapes_uniform(&rng, -0.1, 0.1);
    const double y = n == 0  ? 0.0202
                     : n % 3 ? 0.01 * shapes_pick(&rng, 9) + 1e-4 * shapes_pick(&rng, 3)
                             : shapes_uniform(&rng, -0.1, 0.1);
    const double gap = n == 0 ? 7.9e-4 : shapes_uniform(&rng, 1e-5, 1e-3);
    const nsvcd_pose at_ball = pose_of(x, y, 0.05 + 0.02 + gap, NULL);
    const contacts_of of_ball = ask(&ball, &at_ball, &floor_of_many, NULL, 1.5e-3);
    CHECK_EQ(of_ball.count, 1);
    CHECK_EQ(count_along(&of_ball, 0, 0, 1, gap, 1e-6), 1);
    const nsvcd_pose lying = pose_of(x, y, 0.05 + 0.01 + gap, NULL);
    const contacts_of of_capsule = ask(&capsule, &lying, &floor_of_many, NULL, 1.5e-3);
    CHECK_EQ(of_capsule.count, 2);
    CHECK_EQ(count_along(&of_capsule, 0, 0, 1, gap, 1e-6), 2);
    const double turn[4] = {0, 0, sin(x * 20), cos(x * 20)};
    const nsvcd_pose standing = pose_of(x, y, 0.05 + 0.005 + gap, turn);
    const contacts_of of_box = ask(&box, &standing, &floor_of_many, NULL, 1.5e-3);
    CHECK_EQ(of_box.count, 4);
    CHECK_EQ(count_along(&of_box, 0, 0, 1, gap, 1e-6), 4);
    const oracle_pose stands = seen(&standing);
    for (int corner = 0; corner < 4; corner++) {
      const double own[3] = {corner & 1 ? 0.015 : -0.015, corner & 2 ? 0.01 : -0.01, 0};
      double there[3];
      int has = 0;
      oracle_transform(&stands, own, there);
      for (size_t k = 0; k < of_box.count; k++)
        has |= fabs(there[0] - (double)of_box.at[k].point[0]) < 1e-5 &&
               fabs(there[1] - (double)of_box.at[k].point[1]) < 1e-5;
      CHECK(has);
    }
  }
  thing_free(&floor_of_many);
  thing_free(&box);
  thing_free(&ball);
  thing_free(&capsule);
}

// A box in any rotation, over squares about as small as the margin. The larger body rests.
static void corners_over_fine_floors_have_one_side(void) {
  thing fine = thing_box(0.03, 0.03, 0.01, 20, 1);
  thing boxes[2] = {thing_box(0.01, 0.006, 0.004, 1, 1), thing_box(0.5, 0.3, 0.2, 1, 1)};
  shapes_rng rng = {21};
  for (size_t n = 0; n < check_many(60); n++) {
    double q[4];
    shapes_quaternion(&rng, q);
    const thing *box = &boxes[n % 2];
    nsvcd_pose at = pose_of(0, 0, 0, q);
    const oracle_pose turned = seen(&at);
    double lowest[3] = {0, 0, HUGE_VAL};
    for (size_t k = 0; k < 3 * box->mesh.triangle_count; k++) {
      double corner[3];
      oracle_transform(&turned, box->mesh.triangles[k / 3].v[k % 3], corner);
      if (corner[2] < lowest[2]) memcpy(lowest, corner, sizeof lowest);
    }
    // its lowest corner 0.2 mm over the floor
    at.position[0] = (float)(shapes_uniform(&rng, -0.005, 0.005) - lowest[0]);
    at.position[1] = (float)(shapes_uniform(&rng, -0.005, 0.005) - lowest[1]);
    at.position[2] = (float)(0.0052 - lowest[2]);
    const contacts_of found = ask(box, &at, &fine, NULL, 1.2e-3);
    CHECK_GE(found.count, 1);
    for (size_t k = 0; k < found.count; k++) CHECK_GE(found.at[k].normal[2], 0.79f);
  }
  thing_free(&fine);
  thing_free(&boxes[0]);
  thing_free(&boxes[1]);
}

// A prism along y whose section is this polygon, counter-clockwise in x and z.
static thing prism_of(const double (*section)[2], int count) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_extrude(&shape, section, count, 1);
  const double upright[4] = {sqrt(0.5), 0, 0, sqrt(0.5)};
  shapes_place(&shape, 0, upright, 0, 0, 0);
  return thing_of(&shape, 0, 1);
}

static void ridges_and_grooves(void) {
  static const double ridge[3][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0, 0}};
  thing ball = thing_round(0, 0.1);
  thing on = prism_of(ridge, 3);
  const nsvcd_pose over = pose_of(0, 0.1, 0.1005, NULL);
  const contacts_of found = ask(&ball, &over, &on, NULL, 1e-3);
  CHECK_EQ(found.count, 1);
  CHECK_EQ(count_along(&found, 0, 0, 1, 5e-4, 1e-6), 1);
  thing_free(&on);
  // walls that rise by so many degrees
  static const double slopes[4] = {10, 17, 40, 60};
  for (int n = 0; n < 4; n++) {
    const double angle = slopes[n] * 3.14159265358979 / 180;
    const double rise = 0.5 * tan(angle);
    const double groove[5][2] = {{-0.5, rise}, {-0.5, -0.2}, {0.5, -0.2}, {0.5, rise}, {0, 0}};
    thing in = prism_of(groove, 5);
    const nsvcd_pose at = pose_of(0, 0, 0.1005 / cos(angle), NULL);
    const contacts_of both = ask(&ball, &at, &in, NULL, 1e-3);
    CHECK_EQ(both.count, 2);
    CHECK_EQ(count_along(&both, sin(angle), 0, cos(angle), 5e-4, 1e-6), 1);
    CHECK_EQ(count_along(&both, -sin(angle), 0, cos(angle), 5e-4, 1e-6), 1);
    thing_free(&in);
  }
  thing_free(&ball);
}

// Props that have fallen, and were then pushed aside until they met something or had gone far.
static void props_on_a_level_miss_nothing(void) {
  enum { KINDS = 6 };
  shapes_mesh shapes[KINDS + 1];
  thing props[KINDS];
  size_t size, sides = 0, many = 0;
  int places = 0;
  shapes_rng rng = {3};
  memset(shapes, 0, sizeof shapes);
  shapes_mug(&shapes[0], 0.06, 0.13, 0.008, 32);
  shapes_box(&shapes[1], 0.24, 0.18, 0.2, 2);
  shapes_chair(&shapes[2], 0.24, 0.5, 0.03);
  shapes_knot(&shapes[3], 0.09, 0.03, 64, 12);
  shapes_l_bracket(&shapes[4], 0.24, 0.3, 0.06, 0.12);
  level_boulder(&shapes[5], 0.14, 16, 1);
  level_make(&shapes[KINDS], 8, 12000, 1);
  thing level = thing_of(&shapes[KINDS], 0, 1);
  for (int k = 0; k < KINDS; k++) props[k] = thing_of(&shapes[k], 0, k == 1 ? 0.5 : 1);
  void *memory = workspace(&size);
  for (size_t n = 0; n < check_many(100);) {
    const thing *prop = &props[n % KINDS];
    double q[4];
    nsvcd_answer answer;
    shapes_quaternion(&rng, q);
    const double x = shapes_uniform(&rng, -3, 3);
    const double y = shapes_uniform(&rng, -3, 3);
    nsvcd_pose path[2] = {pose_of(x, y, level_height(x, y) + 1, q), pose_of(x, y, -1, q)};
    nsvcd_question fall = question_of_things(prop, path, &level, NULL, 5e-4);
    fall.ask = NSVCD_ASK_FIRST;
    fall.to = 1e-4f;
    fall.a.count = 2;
    CHECK_EQ(nsvcd_sweep(&fall, memory, size, &answer), NSVCD_OK);
    if (answer.verdict != NSVCD_HIT || !(answer.time.low > 0)) continue;
    path[0] = path[1] = answer.safe.a;
    if (n % 2) {
      // lifted off, then aside until it meets something, and down there
      for (int step = 0; step < 3; step++) {
        path[1] = path[0];
        path[1].position[2] += step == 0 ? 0.02f : step == 2 ? -2.0f : 0.0f;
        for (int k = 0; k < 2 && step == 1; k++)
          path[1].position[k] += (float)shapes_uniform(&rng, -2, 2);
        fall.clearance = step == 0 ? 0 : step == 1 ? 4e-4f : 1e-4f;
        CHECK_EQ(nsvcd_sweep(&fall, memory, size, &answer), NSVCD_OK);
        path[0] = answer.safe.a;
      }
    }
    const double margin = shapes_uniform(&rng, 8e-4, 3e-3);
    const contacts_of found =
        n % 3 ? ask(prop, path, &level, NULL, margin) : ask(&level, NULL, prop, path, margin);
    places += found.places;
    sides += found.count;
    int differ = 0;
    for (size_t k = 0; k < found.count; k++) {
      const float *normal = found.at[k].normal;
      const double first[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
      for (size_t i = 0; i < k; i++) differ |= dot_f(found.at[i].normal, first) < 0.5;
    }
    many += differ;
    n++;
  }
  CHECK_GE(places, 100);
  CHECK_GE(sides, 100);
  CHECK_GE(many, 1);
  for (int k = 0; k < KINDS; k++) thing_free(&props[k]);
  thing_free(&level);
}

static int stop_now(void *user) {
  ++*(int *)user;
  return 1;
}

static void what_may_be_missing_is_told(void) {
  thing floor_of_many = thing_box(0.4, 0.4, 0.1, 40, 1);
  thing fine = thing_box(0.2, 0.2, 0.1, 20, 1);
  const nsvcd_pose at = pose_of(0.003, 0.002, 0.1002, NULL);
  nsvcd_contact contacts[MOST];
  size_t size, count = 99;
  int partial = 99;
  int asked = 0;
  void *memory = workspace(&size);
  nsvcd_question q = question_of_things(&fine, &at, &floor_of_many, NULL, 1e-3);
  CHECK_EQ(nsvcd_contacts(&q, memory, size, contacts, MOST, &count, &partial), NSVCD_OK);
  CHECK_EQ(partial, 1);
  CHECK_GE(count, 1);
  q.work = 1;
  CHECK_EQ(nsvcd_contacts(&q, memory, size, contacts, MOST, &count, &partial), NSVCD_OK);
  CHECK_EQ(partial, 1);
  q.work = 0;
  q.stop = stop_now;
  q.user = &asked;
  CHECK_EQ(nsvcd_contacts(&q, memory, size, contacts, MOST, &count, &partial), NSVCD_OK);
  CHECK_EQ(partial, 1);
  CHECK_GE(asked, 1);
  // room for fewer than there are, and for none
  thing box = thing_box(0.2, 0.2, 0.1, 1, 1);
  q = question_of_things(&box, &at, &floor_of_many, NULL, 1e-3);
  for (size_t most = 0; most < 5; most++) {
    CHECK_EQ(nsvcd_contacts(&q, memory, size, most ? contacts : NULL, most, &count, NULL),
             NSVCD_OK);
    CHECK_EQ(count, most);
  }
  thing_free(&floor_of_many);
  thing_free(&fine);
  thing_free(&box);
}

// Triangles that meet: the contact has no gap, and a direction all the same.
static void what_meets_has_no_gap(void) {
  thing a = thing_box(0.2, 0.2, 0.1, 3, 1);
  thing b = thing_box(0.4, 0.4, 0.1, 5, 1);
  nsvcd_contact contacts[MOST];
  size_t size, count;
  void *memory = workspace(&size);
  const nsvcd_pose at = pose_of(0.01, 0.02, 0.0995, NULL);
  const nsvcd_question q = question_of_things(&a, &at, &b, NULL, 1e-3);
  CHECK_EQ(nsvcd_contacts(&q, memory, size, contacts, MOST, &count, NULL), NSVCD_OK);
  CHECK_GE(count, 1);
  for (size_t k = 0; k < count; k++) {
    const double n[3] = {(double)contacts[k].normal[0], (double)contacts[k].normal[1],
                         (double)contacts[k].normal[2]};
    CHECK_NEAR(oracle_length(n), 1, 1e-6);
  }
  CHECK(contacts[0].gap <= 0);
  thing_free(&a);
  thing_free(&b);
}

static void bad_questions_are_refused(void) {
  thing a = thing_box(0.2, 0.2, 0.1, 1, 1);
  thing b = thing_box(0.4, 0.4, 0.1, 1, 1);
  nsvcd_contact contacts[MOST];
  size_t size, count = 99;
  void *memory = workspace(&size);
  const nsvcd_pose at[2] = {pose_of(0, 0, 0.1, NULL), pose_of(0, 0, 0.2, NULL)};
  const nsvcd_question good = question_of_things(&a, at, &b, NULL, 1e-3);
#define REFUSED(change, code)                                                       \
  do {                                                                              \
    nsvcd_question q = good;                                                        \
    change;                                                                         \
    CHECK_EQ(nsvcd_contacts(&q, memory, size, contacts, MOST, &count, NULL), code); \
    CHECK_EQ(count, 99);                                                            \
  } while (0)
  REFUSED(q.a.count = 2, NSVCD_ERROR_POSES);
  REFUSED((q.b.poses = at, q.b.count = 2), NSVCD_ERROR_POSES);
  REFUSED(q.ask = NSVCD_ASK_FIRST, NSVCD_ERROR_ASK);
  REFUSED(q.ask = NSVCD_ASK_DISTANCE, NSVCD_ERROR_ASK);
  REFUSED(q.clearance = 0, NSVCD_ERROR_CLEARANCE);
  REFUSED(q.clearance = -1, NSVCD_ERROR_CLEARANCE);
  REFUSED(q.slop = 1e-3f, NSVCD_ERROR_SLOP);
  REFUSED(q.to = 1e-3f, NSVCD_ERROR_TO);
  REFUSED(q.manifold = 1, NSVCD_ERROR_MANIFOLD);
  REFUSED(q.method = NSVCD_METHOD_NETWORK, NSVCD_ERROR_METHOD);
  REFUSED(q.a.scale = -1, NSVCD_ERROR_SCALE);
  REFUSED(q.segments = 3, NSVCD_ERROR_SEGMENTS);
  CHECK_EQ(nsvcd_contacts(NULL, memory, size, contacts, MOST, &count, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_contacts(&good, memory, size, NULL, MOST, &count, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_contacts(&good, memory, size, contacts, MOST, NULL, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_contacts(&good, NULL, size, contacts, MOST, &count, NULL), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_contacts(&good, memory, 64, contacts, MOST, &count, NULL), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(count, 99);
  thing_free(&a);
  thing_free(&b);
}

void test_contacts(void) {
  RUN(a_box_in_a_corner_has_three_sides);
  RUN(a_box_between_floor_and_ceiling_has_two_sides);
  RUN(inner_edges_of_a_floor_are_no_sides);
  RUN(corners_over_fine_floors_have_one_side);
  RUN(ridges_and_grooves);
  RUN(props_on_a_level_miss_nothing);
  RUN(what_may_be_missing_is_told);
  RUN(what_meets_has_no_gap);
  RUN(bad_questions_are_refused);
}

CHECK_ALONE(test_contacts)
