// Looks: do the balls cover the mesh, and reach no farther than they say? Is no meeting missed, and
// none invented? Against distances and winding numbers in double, by the oracle.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "body_of.h"
#include "check.h"

void test_looks(void);

// A body, its mesh as the oracle has it, and what is known of it.
typedef struct look_body {
  const nsvcd_body *body;
  oracle_mesh mesh;
  double round, scale;
  // by its balls, or as a box: it is solid, and the error bounds what is invented
  int is_solid, is_box;
  double error;
} look_body;

#define LOOK_KINDS 10
static void look_shape(int kind, shapes_rng *rng, shapes_mesh *shape) {
  memset(shape, 0, sizeof *shape);
  if (kind == 0) shapes_capsule(shape, 0.05, 0.3, 24);
  if (kind == 1) shapes_torus(shape, 0.2, 0.05, 48, 16);
  if (kind == 2) shapes_mug(shape, 0.05, 0.1, 0.008, 32);
  if (kind == 3) shapes_l_bracket(shape, 0.2, 0.15, 0.02, 0.1);
  if (kind == 4) shapes_ellipsoid(shape, 0.2, 0.1, 0.05, 32);
  if (kind == 5) shapes_random_solid(shape, rng, 0.4);
  if (kind == 6) shapes_box(shape, 0.3, 0.2, 0.1, 1);
  if (kind == 7) shapes_cylinder(shape, 0.01, 1, 16);
  if (kind == 8) shapes_random_hollow(shape, rng, 0, 0.3);
  if (kind == 9) {  // two components that overlap, and one apart from them
    shapes_capsule(shape, 0.05, 0.1, 24);
    const size_t first = shape->vertices;
    shapes_box_at(shape, 0.03, 0, 0, 0.1, 0.04, 0.06);
    shapes_box_at(shape, 0.3, 0, 0, 0.1, 0.04, 0.06);
    const double turn[4] = {0, 0.6, 0, 0.8};
    shapes_place(shape, first, turn, 0, 0, 0.02);
  }
}

// balls: 0: none. scale: of the mover; the mesh is scaled for the oracle.
static look_body look_make(int kind, size_t balls, double round, double scale, shapes_rng *rng) {
  shapes_mesh shape;
  look_body out;
  nsvcd_encode_options options;
  memset(&out, 0, sizeof out);
  memset(&options, 0, sizeof options);
  look_shape(kind, rng, &shape);
  options.balls = balls;
  options.convex_radius = (float)round;
  out.round = round * scale;
  out.scale = scale;
  out.body = body_of(&shape, &options);
  const int ok = oracle_mesh_init(&out.mesh, shape.positions, shape.vertices, shape.indices,
                                  shape.triangles, scale);
  if (!ok) exit(1);
  const nsvcd_body_facts facts = nsvcd_body_describe(out.body);
  out.is_solid = balls > 0;
  out.is_box = kind == 6;
  out.error = scale * (double)facts.ball_error;
  shapes_free(&shape);
  return out;
}

static void look_free(look_body *b) {
  nsvcd_body_free(b->body, NULL);
  oracle_mesh_free(&b->mesh);
}

static nsvcd__sphere look_ball(const nsvcd_body *body, size_t n) {
  return nsvcd__sphere_of(nsvcd__covering_of(nsvcd__triangles_of(body)).balls, n);
}

// How far is a point from the solid? 0 inside.
static double look_distance(const oracle_mesh *mesh, const double *point) {
  double nearest = HUGE_VAL;
  if (fabs(oracle_winding(mesh, point)) > 0.5) return 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    oracle_triangle at;
    double on[2][3];
    for (int k = 0; k < 3; k++) memcpy(at.v[k], point, sizeof at.v[k]);
    oracle_triangle_normal(&at);
    const double square = oracle_triangles(&mesh->triangles[t], &at, nearest, on[0], on[1]);
    nearest = fmin(nearest, square);
  }
  return sqrt(nearest);
}

// Is a triangle in the balls? Halved until each part is in one of them, so often at most.
static int look_is_covered(const nsvcd_body *body, size_t balls, double (*t)[3], int depth) {
  for (size_t n = 0; n < balls; n++) {
    const nsvcd__sphere ball = look_ball(body, n);
    const double c[3] = {(double)ball.centre.x, (double)ball.centre.y, (double)ball.centre.z};
    int is_in = 1;
    for (int k = 0; k < 3 && is_in; k++) {
      double offset[3];
      oracle_sub(t[k], c, offset);
      is_in = oracle_length(offset) <= (double)ball.radius;
    }
    if (is_in) return 1;
  }
  if (depth == 0) return 0;
  int longest = 0;
  double length = 0;
  for (int k = 0; k < 3; k++) {
    double edge[3];
    oracle_sub(t[(k + 1) % 3], t[k], edge);
    if (oracle_length(edge) > length) longest = k;
    length = fmax(length, oracle_length(edge));
  }
  double halves[2][3][3];
  memcpy(halves[0], t, sizeof halves[0]);
  memcpy(halves[1], t, sizeof halves[1]);
  for (int k = 0; k < 3; k++) {
    const double middle = 0.5 * (t[longest][k] + t[(longest + 1) % 3][k]);
    halves[0][(longest + 1) % 3][k] = middle;
    halves[1][longest][k] = middle;
  }
  return look_is_covered(body, balls, halves[0], depth - 1) &&
         look_is_covered(body, balls, halves[1], depth - 1);
}

static void balls_cover_the_mesh(void) {
  static const size_t counts[4] = {1, 16, 128, 700};
  static const float scales[3] = {1, 1e-7f, 3e5f};
  shapes_rng rng = {7};
  for (int kind = 0; kind < LOOK_KINDS; kind++) {
    for (int n = kind % 3; n < (kind == 2 ? 4 : 3); n++) {
      const double round = n == 1 ? 0.01 : 0;
      look_body b = look_make(kind, counts[n], round, 1, &rng);
      nsvcd_body_facts facts = nsvcd_body_describe(b.body);
      CHECK(facts.balls > 0);
      CHECK_LE(facts.balls, counts[n]);
      void *copy = malloc(facts.size);
      if (!copy) exit(1);
      for (int k = 0; k < (n == 1 ? 3 : 1); k++) {
        const float scale = scales[k];
        const nsvcd_body *body = NULL;
        CHECK_EQ(nsvcd_body_scale(b.body, (const float[3]){scale, scale, scale}, copy, facts.size,
                                  &body),
                 NSVCD_OK);
        const nsvcd_body *loaded;
        CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_OK);
        size_t uncovered = 0;
        for (size_t t = 0; t < b.mesh.triangle_count; t++) {
          double corners[3][3];
          for (int i = 0; i < 9; i++)
            corners[i / 3][i % 3] = (double)((float)b.mesh.triangles[t].v[i / 3][i % 3] * scale);
          uncovered += !look_is_covered(body, facts.balls, corners, 48);
        }
        CHECK_EQ(uncovered, 0);
        facts = nsvcd_body_describe(body);
        CHECK(facts.ball_error > 0 || kind == 6);
      }
      free(copy);
      look_free(&b);
    }
  }
}

// Points on the balls are no farther from the solid than the body says.
static void balls_reach_no_farther_than_they_say(void) {
  shapes_rng rng = {11};
  size_t beyond = 0;
  double worst = 0;
  for (int kind = 0; kind < LOOK_KINDS; kind++) {
    for (int rounds = kind % 2; rounds <= kind % 2; rounds++) {
      look_body b = look_make(kind, rounds ? 40 : 128, rounds ? 0.02 : 0, 1, &rng);
      const nsvcd_body_facts facts = nsvcd_body_describe(b.body);
      for (size_t n = 0; n < check_many(300); n++) {
        const nsvcd__sphere ball = look_ball(b.body, n % facts.balls);
        double at[3];
        shapes_direction(&rng, at);
        for (int k = 0; k < 3; k++) at[k] *= (double)ball.radius;
        at[0] += (double)ball.centre.x;
        at[1] += (double)ball.centre.y;
        at[2] += (double)ball.centre.z;
        const double off = look_distance(&b.mesh, at) - b.round;
        beyond += off > (double)facts.ball_error;
        worst = fmax(worst, off / (double)facts.ball_error);
      }
      look_free(&b);
    }
  }
  CHECK_EQ(beyond, 0);
  CHECK_GE(worst, 0.5);  // or the errors would be too large to be of use
  if (worst < 0.5) printf("the farthest point: %g of the error\n", worst);
}

// A place, in double, and as a look takes it.
static void look_place(shapes_rng *rng, double reach, oracle_pose *pose, nsvcd_places *places,
                       size_t lane) {
  double m[9];
  shapes_quaternion(rng, pose->rotation);
  shapes_direction(rng, pose->position);
  for (int k = 0; k < 3; k++) pose->position[k] *= reach;
  oracle_matrix(pose->rotation, m);
  for (int k = 0; k < 9; k++) places->rotation[k][lane] = (float)m[k];
  for (int k = 0; k < 3; k++) places->position[k][lane] = (float)pose->position[k];
}

typedef struct look_counts {
  size_t asked, met, missed, invented, extra, inside, unseen;
} look_counts;

// 16 places of two bodies, with a margin.
static void look_at_16(const look_body *a, const look_body *b, float margin, shapes_rng *rng,
                       look_counts *counts) {
  nsvcd_places places[2];
  oracle_pose poses[2][NSVCD_LOOKS];
  const double reach = a->mesh.radius + a->round + b->mesh.radius + b->round + fabs((double)margin);
  for (size_t lane = 0; lane < NSVCD_LOOKS; lane++) {
    look_place(rng, 1.2 * reach * sqrt(shapes_uniform(rng, 0, 1)), &poses[0][lane], &places[0],
               lane);
    look_place(rng, 0.1, &poses[1][lane], &places[1], lane);
  }
  const nsvcd_looked looked[2] = {{a->body, (float)a->scale, &places[0]},
                                  {b->body, (float)b->scale, &places[1]}};
  nsvcd_look_options options = {margin, 0};
  uint32_t met = 0, swapped = 0, any = 0;
  CHECK_EQ(nsvcd_look(&looked[0], &looked[1], &options, &met), NSVCD_OK);
  CHECK_EQ(nsvcd_look(&looked[1], &looked[0], &options, &swapped), NSVCD_OK);
  options.any = 1;
  CHECK_EQ(nsvcd_look(&looked[0], &looked[1], &options, &any), NSVCD_OK);
  CHECK_EQ(any != 0, met != 0);
  CHECK_EQ(any & ~met, 0);
  CHECK_EQ(met >> NSVCD_LOOKS, 0);
  // a box is exact, if the other is none
  const int by_box = a->is_box != b->is_box;
  const int is_solid =
      (a->is_solid || (by_box && a->is_box)) && (b->is_solid || (by_box && b->is_box));
  for (size_t lane = 0; lane < NSVCD_LOOKS; lane++) {
    const oracle_pose *p = &poses[0][lane];
    const oracle_pose *q = &poses[1][lane];
    const double apart =
        oracle_distance(&a->mesh, p, &b->mesh, q, NULL, NULL) - a->round - b->round;
    const int is_inside = oracle_inside(&a->mesh, p, &b->mesh, q) > 0.5 ||
                          oracle_inside(&b->mesh, q, &a->mesh, p) > 0.5;
    const int says = (int)(met >> lane & 1);
    // roundings
    const double slack = 2e-6 * reach;
    const int meets = apart <= 0;
    counts->asked++;
    counts->met += (size_t)says;
    if (margin >= 0) counts->missed += !says && (meets || apart <= (double)margin);
    counts->inside += is_inside && is_solid;
    counts->unseen += is_inside && is_solid && !says && margin >= 0;
    counts->extra += says && apart > (double)margin && !is_inside;
    const double error = (by_box && a->is_box ? 0 : a->error) +
                         (by_box && b->is_box ? 0 : b->error) + (double)margin;
    if (is_solid) counts->invented += says && !is_inside && apart > fmax(error, 0) + slack;
  }
}

// One with balls against all: with balls, without, boxes; of other sizes, with other margins.
static void looks_miss_nothing_and_invent_nothing(void) {
  shapes_rng rng = {3};
  look_counts counts = {0, 0, 0, 0, 0, 0, 0};
  for (size_t n = 0; n < check_many(12); n++) {
    const size_t balls[2] = {n % 4 == 3 ? 0 : 64 + 64 * (n % 3), n % 3 == 1 ? 0 : 128};
    look_body bodies[2];
    double error = 0;
    for (int k = 0; k < 2; k++) {
      // now and then a round box
      const int is_round_box = k == 1 && n % 4 == 2;
      const int kind = is_round_box ? 6 : shapes_pick(&rng, LOOK_KINDS);
      const int is_round = is_round_box || !shapes_pick(&rng, 4);
      const double round = is_round ? shapes_uniform(&rng, 0.01, 0.03) : 0;
      const double scale = shapes_pick(&rng, 3) ? 1 : shapes_uniform(&rng, 0.2, 3);
      bodies[k] = look_make(kind, balls[k], round, (double)(float)scale, &rng);
      error += bodies[k].error;
    }
    const float margins[4] = {0, 0, 0.02f, (float)(-1.0001 * error)};
    for (int k = 0; k < 16; k++) look_at_16(&bodies[0], &bodies[1], margins[k % 4], &rng, &counts);
    look_free(&bodies[0]);
    look_free(&bodies[1]);
  }
  CHECK_EQ(counts.missed, 0);
  CHECK_EQ(counts.invented, 0);
  CHECK_GE(counts.met, counts.asked / 10);
  CHECK_LE(counts.extra, counts.asked / 8);
  CHECK_LE(counts.unseen, counts.inside / 20);
  if (check.failures_in_test || getenv("DBG"))
    printf("%zu places, %zu met, %zu missed, %zu invented, %zu extra; %zu inside, %zu unseen\n",
           counts.asked, counts.met, counts.missed, counts.invented, counts.extra, counts.inside,
           counts.unseen);
}

// A level of many groups, which has levels of spheres, against balls.
static void looks_at_levels_miss_nothing(void) {
  shapes_rng rng = {5};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  for (int n = 0; n < 40; n++)
    shapes_box_at(&shape, shapes_uniform(&rng, -1, 1), shapes_uniform(&rng, -1, 1),
                  shapes_uniform(&rng, -1, 1), 0.1, 0.05, 0.2);
  nsvcd_encode_options options;
  memset(&options, 0, sizeof options);
  options.patches = 2000;
  look_body level;
  memset(&level, 0, sizeof level);
  level.scale = 1;
  level.body = body_of(&shape, &options);
  CHECK_GE(nsvcd_body_describe(level.body).patches, 513);
  if (!oracle_mesh_init(&level.mesh, shape.positions, shape.vertices, shape.indices,
                        shape.triangles, 1))
    exit(1);
  shapes_free(&shape);
  look_counts counts = {0, 0, 0, 0, 0, 0, 0};
  for (int kind = 0; kind < LOOK_KINDS; kind++) {
    look_body b = look_make(kind, kind % 2 ? 128 : 0, 0, 1, &rng);
    for (size_t n = 0; n < check_many(6); n++) look_at_16(&b, &level, 0, &rng, &counts);
    look_free(&b);
  }
  CHECK_EQ(counts.missed, 0);
  CHECK_LE(counts.extra, counts.asked / 4);
  // each point of the surface is seen, by what is no larger
  const nsvcd_body *point = NULL;
  CHECK_EQ(nsvcd_encode_sphere(1e-6f, NULL, &point), NSVCD_OK);
  size_t unseen = 0;
  for (size_t n = 0; n < check_many(200); n++) {
    nsvcd_places places[2];
    oracle_pose pose;
    uint32_t met = 0;
    for (size_t lane = 0; lane < NSVCD_LOOKS; lane++) {
      const size_t t = (size_t)shapes_pick(&rng, (int)level.mesh.triangle_count);
      const double u = shapes_uniform(&rng, 0, 1);
      const double v = shapes_uniform(&rng, 0, 1 - u);
      look_place(&rng, 0, &pose, &places[0], lane);
      for (int k = 0; k < 9; k++) places[1].rotation[k][lane] = k % 4 == 0;
      for (int k = 0; k < 3; k++) {
        const oracle_triangle *at = &level.mesh.triangles[t];
        const double x = (1 - u - v) * at->v[0][k] + u * at->v[1][k] + v * at->v[2][k];
        places[0].position[k][lane] = (float)x;
        places[1].position[k][lane] = 0;
      }
    }
    const nsvcd_looked a = {point, 0, &places[0]};
    const nsvcd_looked b = {level.body, 0, &places[1]};
    CHECK_EQ(nsvcd_look(&a, &b, NULL, &met), NSVCD_OK);
    unseen += met != 0xffff;
  }
  CHECK_EQ(unseen, 0);
  nsvcd_body_free(point, NULL);
  look_free(&level);
}

static void looks_refuse_bad_input(void) {
  shapes_rng rng = {1};
  look_body b = look_make(0, 20, 0, 1, &rng);
  static nsvcd_places places;
  for (size_t lane = 0; lane < NSVCD_LOOKS; lane++)
    for (int k = 0; k < 9; k += 4) places.rotation[k][lane] = 1;
  const nsvcd_looked good = {b.body, 0, &places};
  uint32_t met = 77;
  const float scales[4] = {-1, NAN, 1e7f, 1e-7f};
  for (int k = 0; k < 4; k++) {
    nsvcd_looked bad = good;
    bad.scale = scales[k];
    CHECK_EQ(nsvcd_look(&bad, &good, NULL, &met), NSVCD_ERROR_SCALE);
    CHECK_EQ(nsvcd_look(&good, &bad, NULL, &met), NSVCD_ERROR_SCALE);
  }
  const nsvcd_looked nowhere = {b.body, 0, NULL};
  const nsvcd_looked nobody = {NULL, 0, &places};
  const nsvcd_looked no_body = {(const nsvcd_body *)(const void *)&places, 0, &places};
  CHECK_EQ(nsvcd_look(&good, &nowhere, NULL, &met), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_look(&nobody, &good, NULL, &met), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_look(NULL, &good, NULL, &met), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_look(&good, &good, NULL, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_look(&good, &no_body, NULL, &met), NSVCD_ERROR_BODY);
  const float margins[3] = {NAN, 1e7f, -HUGE_VALF};
  for (int k = 0; k < 3; k++) {
    const nsvcd_look_options options = {margins[k], 0};
    CHECK_EQ(nsvcd_look(&good, &good, &options, &met), NSVCD_ERROR_CLEARANCE);
  }
  CHECK_EQ(met, 77);
  // a body meets itself
  CHECK_EQ(nsvcd_look(&good, &good, NULL, &met), NSVCD_OK);
  CHECK_EQ(met, 0xffff);
  look_free(&b);
}

// Few triangles, open sheets, a point, a segment, options that do not go together.
static void balls_of_odd_meshes(void) {
  float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  uint32_t faces[4][3] = {{0, 1, 2}, {0, 0, 0}, {0, 1, 1}, {1, 2, 3}};
  for (int k = 0; k < 4; k++) {
    const nsvcd_mesh mesh = {positions, faces[k], 4, 1};
    nsvcd_encode_options options;
    memset(&options, 0, sizeof options);
    options.balls = 32;
    options.convex_radius = k == 1 || k == 2 ? 0.1f : 0;
    const nsvcd_body *body = NULL;
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_OK);
    const nsvcd_body_facts facts = nsvcd_body_describe(body);
    CHECK_GE(facts.balls, 1);
    CHECK_LE(facts.balls, 32);
    CHECK_LE(facts.ball_error, 0.3);
    double corners[3][3];
    for (int i = 0; i < 9; i++)
      corners[i / 3][i % 3] = (double)positions[3 * faces[k][i / 3] + (uint32_t)(i % 3)];
    CHECK(look_is_covered(body, facts.balls, corners, 24));
    nsvcd_body_free(body, NULL);
    options.balls = NSVCD_MAX_BALLS + 1;
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_ERROR_COUNT);
  }
}

// A box along its axes is known as one; eight corners and twelve triangles are not enough: an edge
// between two faces is turned.
static void boxes_are_known(void) {
  static float corners[24];
  uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  for (size_t n = 0; n < 24; n++) corners[n] = n / 3 >> n % 3 & 1 ? 1 : -1;
  for (int turned = 0; turned < 2; turned++) {
    const nsvcd_mesh mesh = {corners, faces, 8, 12};
    const nsvcd_body *body = NULL;
    // 0 3 1 and 1 3 7 become 0 3 7 and 0 7 1
    if (turned) {
      const uint32_t other[3] = {0, 7, 1};
      faces[5] = 7;
      memcpy(faces + 30, other, sizeof other);
    }
    CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body), NSVCD_OK);
    CHECK_EQ(nsvcd_body_describe(body).open_components, 0);
    CHECK_EQ(nsvcd__counts_of(nsvcd__triangles_of(body))->is_box, !turned);
    nsvcd_body_free(body, NULL);
  }
}

// Balls are checked as all else is: damaged ones are refused, whatever the checksum says.
static void damaged_balls_are_refused(void) {
  shapes_rng rng = {1};
  look_body b = look_make(1, 51, 0, 1, &rng);
  const size_t size = nsvcd_body_describe(b.body).size;
  nsvcd_body *copy = (nsvcd_body *)malloc(size);
  if (!copy) exit(1);
  for (int damage = 0; damage < 8; damage++) {
    memcpy(copy, b.body, size);
    const nsvcd__geometry f = nsvcd__geometry_of(copy);
    const size_t slots = nsvcd__round_up(f.counts->balls, 16);
    if (damage == 1) f.balls[3 * slots] = -1;
    if (damage == 2) f.balls[5] = NAN;
    if (damage == 3) f.balls[slots - 1] = 1;               // of padding
    if (damage == 4) f.balls[4 * slots + 3 * 16] *= 0.5f;  // a cluster
    if (damage == 5) f.counts->balls = NSVCD_MAX_BALLS + 1;
    if (damage == 6) f.counts->ball_error = -1;
    if (damage == 7) f.counts->is_box = 2;
    copy->checksum = nsvcd__body_checksum(copy);
    const nsvcd_body *loaded = NULL;
    CHECK_EQ(nsvcd_body_load(copy, size, &loaded), damage ? NSVCD_ERROR_BODY : NSVCD_OK);
  }
  free(copy);
  look_free(&b);
}

void test_looks(void) {
  RUN(looks_refuse_bad_input);
  RUN(balls_of_odd_meshes);
  RUN(boxes_are_known);
  RUN(damaged_balls_are_refused);
  RUN(looks_at_levels_miss_nothing);
  RUN(looks_miss_nothing_and_invent_nothing);
  RUN(balls_reach_no_farther_than_they_say);
  RUN(balls_cover_the_mesh);
}

CHECK_ALONE(test_looks)
