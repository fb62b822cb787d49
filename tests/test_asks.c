// What questions ask beyond yes or no, in scenes of a few triangles whose answers are known: things
// that stand on a table, pass each other at a known distance, cross where they start. The Makefile
// compiles this file with products fused into sums where the processor can: rounded otherwise, what
// has no area may seem to have some. bench/check_options.c asks such questions at random.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "body_of.h"
#include "../examples/scenery/oracle.h"
#include "question_of.h"
#include "check.h"
#include "../examples/scenery/status_of.h"

void test_asks(void);

static const nsvcd_body *asks_body_with(shapes_mesh *shape, const nsvcd_encode_options *options) {
  const nsvcd_body *body = body_of(shape, options);
  shapes_free(shape);
  return body;
}
static const nsvcd_body *asks_body(shapes_mesh *shape, size_t patches) {
  const nsvcd_encode_options options = {.patches = patches};
  return asks_body_with(shape, &options);
}

static nsvcd_answer asks(const nsvcd_question *question) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(512, 512, 64));
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_sweep(question, workspace, sizeof workspace, &answer), NSVCD_OK);
  return answer;
}

// A pose at x, y, z, turned about z.
static nsvcd_pose asks_pose(double x, double y, double z, double turn) {
  const nsvcd_pose out = {{(float)x, (float)y, (float)z},
                          {0, 0, (float)sin(turn / 2), (float)cos(turn / 2)}};
  return out;
}

// -------------------------------------------------------------------------------------------------
// skin

// What stands on its base, the lowest point at z = 0: cones and pyramids whose sides rise from a
// sharp rim, a cone of triangles smaller than the skin, a cup, boxes.
#define STANDING 16
static double asks_corner;  // of the last box, from its middle
static double asks_reach;   // of the last one, from its axis
static const nsvcd_body *asks_standing(int n, shapes_rng *rng) {
  shapes_mesh shape;
  double low[3], high[3];
  memset(&shape, 0, sizeof shape);
  if (n < 5) shapes_cone(&shape, 0.05, 0, 0.01 + 0.035 * n, n % 2 ? 4 : 24);
  if (n == 5) shapes_cone(&shape, 0.05, 0.03, 0.05, 24);
  if (n == 6) shapes_cone(&shape, 0.016, 0, 0.004, 64);
  if (n == 7) shapes_cup(&shape, 0.04, 0.09, 0.003, 1.2, 24);
  for (int k = 0; n > 7 && k < 3; k++) low[k] = shapes_uniform(rng, 0.02, 0.2);
  if (n > 7) shapes_box(&shape, low[0], low[1], low[2], n % 3 ? 1 : 4);
  shapes_bounds(&shape, low, high);
  asks_corner = hypot(high[0], high[1]);
  asks_reach = 0;
  for (size_t i = 0; i < shape.vertices; i++)
    asks_reach = fmax(asks_reach, hypot(shape.positions[3 * i], shape.positions[3 * i + 1]));
  for (size_t i = 0; i < shape.vertices; i++) shape.positions[3 * i + 2] -= low[2];
  return asks_body(&shape, 0);
}

// A slab whose top is z = 0, alone or with two walls at x = 0.3 and y = 0.3.
static const nsvcd_body *asks_table(int walls, int cuts) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 1, 1, 0.05, cuts);
  for (size_t i = 0; i < shape.vertices; i++) shape.positions[3 * i + 2] -= 0.025;
  if (walls) {
    shapes_box_at(&shape, 0.325, 0, 0.25, 0.05, 1, 0.5);
    shapes_box_at(&shape, 0, 0.325, 0.25, 1, 0.05, 0.5);
  }
  return asks_body(&shape, 0);
}

static double asks_length(const float *v) {
  return sqrt((double)(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
}

// Where the answer sends them, lift and all, are the bodies free of each other without a skin?
static void asks_check_safe(const nsvcd_question *question, const nsvcd_answer *answer) {
  nsvcd_question still = *question;
  still.ask = NSVCD_ASK_HIT;
  still.to = still.to_time = still.slop = 0;
  still.clearance *= 0.99f;
  still.manifold = 0;
  still.a.poses = &answer->safe.a;
  still.b.poses = &answer->safe.b;
  still.a.count = still.b.count = 1;
  CHECK_EQ(asks(&still).verdict, NSVCD_FREE);
}

// What stands on a table, flush or pressed in by less than the skin, still or sliding, is lifted by
// the skin, straight up; by more, it is hit. So is the table under it.
static void asks_skin_lifts_what_stands(void) {
  static const double depths[7] = {0, 1e-5, 1e-4, 3e-4, 5e-4, 9e-4, -3e-5};
  const double skin = 1e-3;
  shapes_rng rng = {25};
  const nsvcd_body *tables[2] = {asks_table(0, 1), asks_table(0, 16)};
  const double table_hair = (double)nsvcd_body_describe(tables[0]).quantization_error;
  for (int n = 0; n < 3 * STANDING; n++) {
    const nsvcd_body *body = asks_standing(n % STANDING, &rng);
    const double epsilon = 2 * (table_hair + (double)nsvcd_body_describe(body).quantization_error);
    for (int trial = 0; trial < 4 * 8; trial++) {
      const int k = trial % 8;
      const double depth = k < 7 ? depths[k] : 1.7 * skin;
      const double turn = shapes_uniform(&rng, 0, 6.28);
      const double x = shapes_uniform(&rng, -0.2, 0.2);
      const double way = trial & 8 ? 0.1 : 0;
      const nsvcd_pose path[2] = {asks_pose(x, 0.01, -depth, turn),
                                  asks_pose(x + way, 0.01, -depth, turn)};
      nsvcd_question question =
          question_of(body, path, trial & 8 ? 2 : 1, tables[trial / 16], NULL, NULL);
      question.slop = (float)skin;
      // the table may move as well, though it stays
      const nsvcd_pose stays[2] = {asks_pose(0, 0, 0, 0), asks_pose(0, 0, 0, 0)};
      question.b.poses = stays;
      question.b.count = trial & 8 && turn < 2 ? 2 : 1;
      const nsvcd_answer answer = asks(&question);
      if (k < 7) asks_check_safe(&question, &answer);
      CHECK_EQ(answer.verdict == NSVCD_FREE, k < 7);
      CHECK_NEAR(answer.push_out[2], k < 7 ? skin : 0, 1e-6);
      CHECK_NEAR(asks_length(answer.push_out), k < 7 ? skin : 0, 1e-6);
      if (k < 7) CHECK_NEAR(answer.depth, fmax(depth, 0), 0.01 * fmax(depth, 0) + epsilon);
      // it is set down to a little above the table
      if (k < 7)
        CHECK_NEAR(answer.safe.a.position[2], fmax(-depth, 0),
                   1.1 * fmax(0.02 * skin, 2 * epsilon) + 0.01 * skin);
      if (k == 7) CHECK_EQ(answer.depth, HUGE_VALF);
      const nsvcd_mover mover = question.a;
      question.a = question.b;
      question.b = mover;
      const nsvcd_answer swapped = asks(&question);
      CHECK_EQ(status_of(&swapped), status_of(&answer));
      CHECK_EQ(swapped.push_out[2], -answer.push_out[2]);
      if (k < 7) asks_check_safe(&question, &swapped);
    }
    nsvcd_body_free(body, NULL);
  }
  nsvcd_body_free(tables[0], NULL);
  nsvcd_body_free(tables[1], NULL);
}

// A box over a table, nearer than `to`, that then goes into it by less than the skin: a hit; but by
// FIRST it is lifted off, for it may have been stopped there, and that it did not touch is said.
static void asks_skin_of_what_is_near(void) {
  const float skin = 2e-3f;
  const nsvcd_body *table = asks_table(0, 1);
  shapes_rng rng = {56};
  const nsvcd_body *box = asks_standing(9, &rng);
  for (int n = 0; n < 40; n++) {
    const double gap =
        (double)skin * (n % 2 ? shapes_uniform(&rng, 0.1, 0.38) : shapes_uniform(&rng, 0.45, 0.9));
    const double into = shapes_uniform(&rng, 0.1, 0.9) * (double)skin;
    const nsvcd_pose path[2] = {asks_pose(0, 0, gap, 0.1 * n), asks_pose(0.1, 0, -into, 0.1 * n)};
    nsvcd_question question = question_of(box, path, 2, table, NULL, NULL);
    question.slop = skin;
    const nsvcd_answer plain = asks(&question);
    CHECK_EQ(plain.verdict, NSVCD_HIT);
    CHECK_EQ(asks_length(plain.push_out), 0);
    question.ask = NSVCD_ASK_FIRST;
    question.to = 0.4f * skin;
    const nsvcd_answer first = asks(&question);
    CHECK_EQ(first.verdict, n % 2 ? NSVCD_FREE : NSVCD_HIT);
    CHECK_NEAR(first.push_out[2], n % 2 ? skin : 0, 1e-6);
    CHECK_EQ(first.depth, 0);
    asks_check_safe(&question, &first);
  }
  nsvcd_body_free(table, NULL);
  nsvcd_body_free(box, NULL);
}

// Boxes of all sizes, pressed a little into a corner, with a skin that is a good part of them: lifted
// out of both walls and the floor, and not on through one.
static void asks_skin_of_boxes_in_a_corner(void) {
  const nsvcd_body *corner = asks_table(1, 1);
  shapes_rng rng = {57};
  for (int n = 0; n < 120; n++) {
    shapes_mesh shape;
    double half[3];
    memset(&shape, 0, sizeof shape);
    for (int k = 0; k < 3; k++) half[k] = shapes_uniform(&rng, 0.01, 0.1);
    shapes_box(&shape, 2 * half[0], 2 * half[1], 2 * half[2], n % 3 ? 1 : 4);
    const nsvcd_body *box = asks_body(&shape, 0);
    const double skin = 0.01;
    const double in = skin * pow(10, shapes_uniform(&rng, -3, -0.3));
    const nsvcd_pose pose = asks_pose(0.3 - half[0] + in, 0.3 - half[1] + in, half[2] - in, 0);
    nsvcd_question question = question_of(box, &pose, 1, corner, NULL, NULL);
    question.slop = (float)skin;
    question.clearance = n % 2 ? 1e-3f : 0;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    for (int k = 0; k < 3; k++) CHECK_NEAR(answer.push_out[k], k < 2 ? -skin : skin, 0.02 * skin);
    asks_check_safe(&question, &answer);
    nsvcd_body_free(box, NULL);
  }
  nsvcd_body_free(corner, NULL);
}

// A box in the corner of a floor and two walls, of triangles larger and smaller than the skin: it
// is lifted off all three. Between two walls nothing lifts it.
static void asks_skin_in_a_corner(void) {
  const nsvcd_body *corner = asks_table(1, 1);
  for (int fine = 0; fine < 2; fine++) {
    const double skin = fine ? 0.01 : 1e-3;
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    shapes_box(&shape, 0.1, 0.1, 0.1, fine ? 16 : 1);
    const nsvcd_body *box = asks_body(&shape, 0);
    const double epsilon = 4 * (double)(nsvcd_body_describe(corner).quantization_error +
                                        nsvcd_body_describe(box).quantization_error);
    for (int k = 0; k < 4; k++) {
      const double in = 0.2 * k * skin;
      const nsvcd_pose pose = asks_pose(0.25 + in, 0.25 + in, 0.05 - in, 0);
      nsvcd_question question = question_of(box, &pose, 1, corner, NULL, NULL);
      question.slop = (float)skin;
      const nsvcd_answer answer = asks(&question);
      CHECK_EQ(answer.verdict, NSVCD_FREE);
      CHECK_NEAR(answer.push_out[0], -skin, 0.02 * skin);
      CHECK_NEAR(answer.push_out[1], -skin, 0.02 * skin);
      CHECK_NEAR(answer.push_out[2], skin, 0.02 * skin);
      // each wall by its own depth
      CHECK_NEAR(answer.depth, sqrt(3) * in, 0.01 * in + epsilon);
      asks_check_safe(&question, &answer);
      const nsvcd_pose lower = asks_pose(0.25, 0.25 + in, 0.05 - in, 0);
      question.a.poses = &lower;
      const nsvcd_answer uneven = asks(&question);
      CHECK_NEAR(uneven.depth, sqrt(2) * in, 0.01 * in + epsilon);
      asks_check_safe(&question, &uneven);
      question.a.poses = &pose;
    }
    nsvcd_body_free(box, NULL);
    memset(&shape, 0, sizeof shape);
    shapes_box_at(&shape, 0.05 + 1e-4 - skin / 2, 0, 0, 0.1, 0.2, 0.2);
    shapes_box_at(&shape, -0.15, 0, 0, 0.1, 0.2, 0.2);
    const nsvcd_body *slot = asks_body(&shape, 0);
    memset(&shape, 0, sizeof shape);
    shapes_box_at(&shape, -0.05, 0, 0, 0.1, 0.1, 0.1);
    const nsvcd_body *held = asks_body(&shape, 0);
    nsvcd_question question = question_of(held, NULL, 0, slot, NULL, NULL);
    question.slop = (float)skin;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_EQ(asks_length(answer.push_out), 0);
    nsvcd_body_free(held, NULL);
    nsvcd_body_free(slot, NULL);
  }
  nsvcd_body_free(corner, NULL);
}

// A box on a floor, under a ceiling that is nearer than the skin: it is lifted by what it needs.
static void asks_skin_under_a_ceiling(void) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, 0, 0, -0.05, 1, 1, 0.1);
  shapes_box_at(&shape, 0, 0, 0.1504, 1, 1, 0.1);
  const nsvcd_body *gap = asks_body(&shape, 0);
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, 0, 0, 0.05, 0.1, 0.1, 0.1);
  const nsvcd_body *box = asks_body(&shape, 0);
  for (int k = 0; k < 5; k++) {
    // of 0.4 mm; the last one is pressed in by more than there is room for
    const double depth = k < 4 ? 1e-4 * k : 1.2e-3;
    const nsvcd_pose path[2] = {asks_pose(0, 0, -depth, 0), asks_pose(0.2, 0, -depth, 0)};
    nsvcd_question question = question_of(box, path, 2, gap, NULL, NULL);
    question.slop = 1e-3f;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, k < 4 ? NSVCD_FREE : NSVCD_HIT);
    if (k < 4) CHECK_NEAR(answer.depth, depth, 0.01 * depth + 4e-5);
    CHECK_LE(answer.push_out[2], 4e-4 + depth);
    if (k < 4) asks_check_safe(&question, &answer);
  }
  nsvcd_body_free(box, NULL);
  nsvcd_body_free(gap, NULL);
}

// A bar on its edge rests across the edge of another: what parts them is across both edges, and of
// all their faces none.
static void asks_skin_of_edge_on_edge(void) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 1, 0.1, 0.1, 1);
  const nsvcd_body *bar = asks_body(&shape, 0);
  const double down = 0.05 * sqrt(2);  // the edge, from the middle
  const float half[2] = {(float)sin(SHAPES_PI / 8), (float)cos(SHAPES_PI / 8)};
  const nsvcd_pose lies = {{0, 0, 0}, {half[0], 0, 0, half[1]}};
  for (int k = 0; k < 64; k++) {
    // turned by 45 degrees about itself, and by more than that about z
    const double turn = 0.3 + 0.08 * (k % 32) + (k % 2 ? SHAPES_PI : 0);
    const float c = (float)cos(turn / 2);
    const float s = (float)sin(turn / 2);
    const double depth = 2.5e-5 * (k % 40);
    nsvcd_pose path[2] = {lies, lies};
    for (int n = 0; n < 2; n++) {
      const float q[4] = {c * half[0], s * half[0], s * half[1], c * half[1]};
      memcpy(path[n].rotation, q, sizeof q);
      path[n].position[0] = 0.02f * (float)n;
      path[n].position[2] = (float)(2 * down - depth);
    }
    nsvcd_question question = question_of(bar, path, k < 32 ? 1 : 2, bar, &lies, NULL);
    question.slop = 1e-3f;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    CHECK_NEAR(answer.push_out[2], 1e-3, 5e-6);
    CHECK_NEAR(answer.depth, depth, 0.01 * depth + 5e-5);
    asks_check_safe(&question, &answer);
  }
  nsvcd_body_free(bar, NULL);
}

// A convex mesh: how far it reaches along a direction; and its directions, of faces and of edges.
typedef struct asks_convex {
  double corners[64][3], faces[128][3], edges[384][3];
  size_t corner_count, face_count, edge_count;
} asks_convex;

// Adds a direction, made unit, if it is new; the other way round is the same.
static void asks_add_way(const double *way, double (*ways)[3], size_t *count) {
  double unit[3];
  const double length = oracle_length(way);
  if (!(length > 1e-9)) return;
  for (int k = 0; k < 3; k++) unit[k] = way[k] / length;
  for (size_t i = 0; i < *count; i++)
    if (fabs(oracle_dot(ways[i], unit)) > 1 - 1e-9) return;
  memcpy(ways[(*count)++], unit, sizeof unit);
}

// One of a shape, turned.
static void asks_convex_of(const shapes_mesh *shape, const double *rotation, asks_convex *out) {
  double m[9];
  memset(out, 0, sizeof *out);
  oracle_matrix(rotation, m);
  for (size_t i = 0; i < 3 * shape->triangles; i += 3) {
    double at[3][3], edges[3][3], normal[3];
    for (size_t k = 0; k < 3; k++) {
      double corner[3];
      for (int c = 0; c < 3; c++)
        corner[c] = (double)(float)shape->positions[3 * shape->indices[i + k] + (size_t)c];
      oracle_rotate(m, corner, at[k]);
      int is_new = 1;
      for (size_t n = 0; n < out->corner_count; n++)
        is_new = is_new && memcmp(out->corners[n], at[k], sizeof at[k]) != 0;
      if (is_new) memcpy(out->corners[out->corner_count++], at[k], sizeof at[k]);
    }
    for (int k = 0; k < 3; k++) oracle_sub(at[(k + 1) % 3], at[k], edges[k]);
    oracle_cross(edges[0], edges[1], normal);
    for (int k = 0; k < 3; k++) asks_add_way(edges[k], out->edges, &out->edge_count);
    if (oracle_length(normal) > 1e-9) asks_add_way(normal, out->faces, &out->face_count);
  }
}

// How far a, at this place, must go along n, unit, until a plane normal to it has b on its other
// side.
static double asks_way_along(const asks_convex *a, const double *place, const asks_convex *b,
                             const double *n) {
  double lowest = DBL_MAX;
  double highest = -DBL_MAX;
  for (size_t i = 0; i < a->corner_count; i++) lowest = fmin(lowest, oracle_dot(n, a->corners[i]));
  for (size_t i = 0; i < b->corner_count; i++)
    highest = fmax(highest, oracle_dot(n, b->corners[i]));
  return highest - lowest - oracle_dot(n, place);
}

// The same, the least of all directions that there are to try: negative if they are apart.
static double asks_least_way(const asks_convex *a, const double *place, const asks_convex *b) {
  double least = DBL_MAX;
  for (int kind = 0; kind < 3; kind++) {
    const size_t outer = kind == 1 ? b->face_count : kind == 0 ? a->face_count : a->edge_count;
    const size_t inner = kind < 2 ? 1 : b->edge_count;
    for (size_t i = 0; i < outer * inner; i++) {
      double n[3];
      if (kind < 2) memcpy(n, kind ? b->faces[i] : a->faces[i], sizeof n);
      if (kind == 2) oracle_cross(a->edges[i / inner], b->edges[i % inner], n);
      const double length = oracle_length(n);
      if (!(length > 1e-6)) continue;
      for (int side = 0; side < 2; side++) {
        for (int k = 0; k < 3; k++) n[k] /= side ? -1 : length;
        least = fmin(least, asks_way_along(a, place, b, n));
      }
    }
  }
  return least;
}

// Convex bodies in each other, turned any way: their depth is the smallest lift that there is, to a
// few per cent and what triangles are stored to, whatever the skin is, also where they are scaled.
static void asks_depth_is_the_least(void) {
  shapes_rng rng = {55};
  size_t asked = 0;
  for (int n = 0; n < 120; n++) {
    const nsvcd_body *bodies[2];
    static asks_convex convex[2];
    double rotations[2][4];
    double size = DBL_MAX;
    const float scale = n % 4 == 3 ? 2.5f : 1;
    for (int k = 0; k < 2; k++) {
      shapes_mesh shape;
      memset(&shape, 0, sizeof shape);
      const double width = shapes_uniform(&rng, 0.1, 0.5);
      if ((n + k) % 3 == 0)
        shapes_cone(&shape, width, k ? 0 : 0.5 * width, 0.4, 6);
      else
        shapes_box(&shape, width, shapes_uniform(&rng, 0.1, 0.5), shapes_uniform(&rng, 0.1, 0.5),
                   1);
      shapes_quaternion(&rng, rotations[k]);
      nsvcd_pose rounded;
      for (int c = 0; c < 4; c++)
        rotations[k][c] = (double)(rounded.rotation[c] = (float)rotations[k][c]);
      asks_convex_of(&shape, rotations[k], &convex[k]);
      bodies[k] = asks_body(&shape, 0);
      size = fmin(size, width);
    }
    const double quanta = (double)nsvcd_body_describe(bodies[0]).quantization_error +
                          (double)nsvcd_body_describe(bodies[1]).quantization_error;
    // pressed in so deep along some way
    const double depth = size * pow(10, shapes_uniform(&rng, -2.5, -0.8));
    double way[3], place[3];
    double low = 0;
    double high = 4;
    for (int k = 0; k < 3; k++) way[k] = shapes_uniform(&rng, -1, 1);
    const double length = oracle_length(way);
    for (int step = 0; step < 60; step++) {
      const double middle = 0.5 * (low + high);
      for (int k = 0; k < 3; k++) place[k] = middle * way[k] / length;
      if (asks_least_way(&convex[0], place, &convex[1]) > depth)
        low = middle;
      else
        high = middle;
    }
    nsvcd_pose poses[2];
    for (int k = 0; k < 2; k++) {
      for (int c = 0; c < 4; c++) poses[k].rotation[c] = (float)rotations[k][c];
      for (int c = 0; c < 3; c++) {
        poses[k].position[c] = k ? 0 : scale * (float)place[c];
        if (k == 0) place[c] = (double)poses[k].position[c] / (double)scale;
      }
    }
    const double least = asks_least_way(&convex[0], place, &convex[1]);
    if (fabs(least - depth) > 1e-5 * depth) continue;
    const double skins[4] = {1.5 * depth, 10 * depth, 1, 20};
    for (int k = 0; k < 4; k++) {
      nsvcd_question question = question_of(bodies[0], &poses[0], 1, bodies[1], &poses[1], NULL);
      question.a.scale = question.b.scale = scale;
      question.slop = scale * (float)skins[k];
      if (n % 2) question.ask = NSVCD_ASK_FIRST;
      const nsvcd_answer answer = asks(&question);
      const double told = (double)answer.depth / (double)scale;
      CHECK_LE(told, 1.03 * least + 4 * quanta);
      CHECK_GE(told, 0.99 * least - 4 * quanta);
      asked++;
      if (told < HUGE_VAL) asks_check_safe(&question, &answer);
    }
    for (int k = 0; k < 2; k++) nsvcd_body_free(bodies[k], NULL);
  }
  CHECK_GE(asked, 300);
}

// -------------------------------------------------------------------------------------------------
// measure

// Two balls pass each other: what their clearance alone decides stays decided when the distance is
// measured as well, however finely, with any work; and no bound that costs nothing is lost.
static void asks_measure_loses_nothing(void) {
  static const double distances[5] = {10, 0.3, 0.22, 0.2010, 0.20001};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_ellipsoid(&shape, 0.1, 0.1, 0.1, 24);
  const nsvcd_body *ball = asks_body(&shape, 0);
  nsvcd_pose path[65];
  for (int k = 0; k < 5; k++) {
    const double gap = distances[k] - 0.2;  // of the balls; of their triangles up to 2 mm more
    for (size_t n = 0; n < 65; n++)
      path[n] = asks_pose(distances[k], -0.2 + 0.4 * (double)n / 64, 0, 0.01 * (double)n);
    for (int c = 0; c < 3; c++) {
      static const float clearances[3] = {0, 1e-3f, 1e-2f};
      nsvcd_question question = question_of(ball, path, k % 2 ? 65 : 2, ball, NULL, NULL);
      path[1] = k % 2 ? path[1] : asks_pose(distances[k], 0.2, 0, 0.3);
      question.clearance = clearances[c];
      const nsvcd_answer plain = asks(&question);
      CHECK(plain.verdict != NSVCD_UNDECIDED);
      for (int m = 0; m < 4; m++) {
        float low = 0;
        question.ask = NSVCD_ASK_DISTANCE;
        question.to = (float)pow(10, -2 - m);
        const size_t least = plain.work ? 16 * (plain.work + 1) : 1;
        for (question.work = least; question.work < 2000000; question.work *= 16) {
          const nsvcd_answer answer = asks(&question);
          CHECK_EQ(status_of(&answer), status_of(&plain));
          CHECK_LE(answer.distance.low, gap + 0.002);
          CHECK_GE(answer.distance.high, gap);
          CHECK_GE(answer.distance.low, gap - 0.2);  // the balls about their boxes' corners
          const double quanta = 2 * (double)nsvcd_body_describe(ball).quantization_error;
          const double wide = fmax((double)question.to, 2 * quanta) + quanta;
          const double allowed = wide + 3e-6 * distances[k];
          const double high = (double)answer.distance.high;
          const double width = high - (double)answer.distance.low;
          if (answer.work < question.work) CHECK_LE(width, allowed);
          // what was not enough is said, and nothing else
          if (answer.why == NSVCD_WHY_NOTHING) CHECK_LE(width, allowed);
          if (width <= (double)question.to) CHECK_EQ(answer.why, NSVCD_WHY_NOTHING);
          CHECK_GE(answer.distance.low, fmin(0.99 * (double)low, high - allowed));
          low = answer.distance.low;
        }
      }
    }
  }
  nsvcd_body_free(ball, NULL);
}

// -------------------------------------------------------------------------------------------------
// first contact

// A box stands on a coarse table, nearer than its triangles are known, for a third of the motion, then is
// carried through a post: the contact that a plain question finds is known to one that asks when as
// well, and what is free before the doubt stays free.
static void asks_first_keeps_what_is_proven(void) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 1, 1, 0.05, 12);
  for (size_t i = 0; i < shape.vertices; i++) shape.positions[3 * i + 2] -= 0.025;
  shapes_box_at(&shape, 0.4, 0, 0.3, 0.05, 0.05, 0.6);
  const nsvcd_encode_options coarse = {.patches = 192, .coarse = 1};
  const nsvcd_body *table = asks_body_with(&shape, &coarse);
  const nsvcd_body_facts facts = nsvcd_body_describe(table);
  CHECK_GE(facts.quantization_error, 1e-9);
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, 0, 0, 0.05, 0.1, 0.1, 0.1);
  const nsvcd_body *box = asks_body(&shape, 192);
  for (int start = 0; start < 2; start++) {
    nsvcd_pose path[33];
    float until = 0;
    const double epsilon = 0.5 * (double)facts.quantization_error;
    for (int n = 0; n < 33; n++) {
      const double down = start ? fmax(0, 0.2 - 0.02 * n) : 0;  // set down, or there already
      path[n] = asks_pose(-0.4 + 0.8 * fmax(0, (n - 12) / 20.0), 0, epsilon + down, 0);
    }
    nsvcd_question question = question_of(box, path, 33, table, NULL, NULL);
    const nsvcd_answer plain = asks(&question);
    CHECK_EQ(status_of(&plain), STATUS_WITNESS);
    for (int m = 1; m < 5; m++) {
      question.ask = NSVCD_ASK_FIRST;
      question.to_time = (float)pow(10, -m);
      const nsvcd_answer answer = asks(&question);
      CHECK_EQ(status_of(&answer), STATUS_WITNESS);
      CHECK_LE(answer.time.low, answer.nearest.time);
      CHECK_GE(answer.time.low, until - question.to_time);
      CHECK(!start || answer.time.low > 0.2f - question.to_time);
      until = answer.time.low;
    }
  }
  nsvcd_body_free(table, NULL);
  nsvcd_body_free(box, NULL);
}

// What slides over a table, a tenth of a millimetre above it or with a skin. A contact is named
// within the motion, also where it is nearer than the clearance from the start; and whoever has
// budget left has an answer, however little there was.
static void asks_first_within_the_motion(void) {
  const nsvcd_body *table = asks_table(1, 16);
  shapes_rng rng = {46};
  for (int n = 0; n < STANDING; n++) {
    const nsvcd_body *body = asks_standing(n, &rng);
    for (int m = 0; m < 48; m++) {
      const double turn = m % 3 ? 0 : 0.3;
      const double z = m % 2 ? 1e-4 : 0;
      const nsvcd_pose path[2] = {asks_pose(-0.2, 0, z, 0), asks_pose(0, 0.02, z, turn)};
      nsvcd_question question = question_of(body, path, 2, table, NULL, NULL);
      question.ask = NSVCD_ASK_FIRST;
      question.to_time = m % 4 < 2 ? 0.1f : 1e-3f;
      question.slop = m % 2 ? 0 : 1e-2f;
      question.clearance = m % 8 == 1 ? 1e-2f : 0;
      question.work = (size_t)(16 * pow(1.15, m));
      const nsvcd_answer answer = asks(&question);
      CHECK_GE(answer.nearest.time, 0);
      CHECK_LE(answer.nearest.time, 1);
      if (answer.verdict == NSVCD_UNDECIDED) CHECK_LE((double)answer.time.low, 1 - 1e-6);
      if (question.clearance > 0 && z > 0 && answer.verdict == NSVCD_HIT)
        CHECK_EQ(answer.time.low, 0);
    }
    nsvcd_body_free(body, NULL);
  }
  nsvcd_body_free(table, NULL);
}

// A piston turns in its cylinder, half a millimetre from it all around, and goes through a plate on
// its way, or just after it starts, or there is none: contacts that take a lot of work to find.
// However little there is, what is told is true, and with more of it no less is proven, but for `to_time`.
static void asks_first_of_little_work(void) {
  static const double plates[3] = {0.205, 0.1003, 1};
  static const double meets[3] = {(1 + 0.105 / 0.15) / 3, 0.0003 / 0.15 / 3, 1};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_cylinder(&shape, 0.1, 0.2, 48);
  const nsvcd_body *piston = asks_body(&shape, 0);
  for (int n = 0; n < 3; n++) {
    memset(&shape, 0, sizeof shape);
    shapes_ring(&shape, 0.12, 0.1005, 0.2, 48);
    shapes_box_at(&shape, 0.05, 0, plates[n] + 0.005, 0.03, 0.03, 0.01);
    const nsvcd_body *cylinder = asks_body(&shape, 0);
    const nsvcd_pose path[4] = {asks_pose(0, 0, 0, 0), asks_pose(0, 0, n == 1 ? 0.15 : 0, 1.5),
                                asks_pose(0, 0, 0.15, 1.6), asks_pose(0, 0, 0, 3)};
    nsvcd_question question = question_of(piston, path, 4, cylinder, NULL, NULL);
    float low = 0;
    question.ask = NSVCD_ASK_FIRST;
    question.to_time = 1e-3f;
    for (size_t work = 64; work < 300000; work += work / 2) {
      question.work = work;
      const nsvcd_answer answer = asks(&question);
      CHECK(answer.verdict != (n < 2 ? NSVCD_FREE : NSVCD_HIT));
      CHECK_GE(answer.time.low, low - question.to_time);
      CHECK_LE((double)answer.time.low, meets[n] + 1e-6);
      low = answer.time.low;
    }
    CHECK(n == 1 || low > 0.2f);
    nsvcd_body_free(cylinder, NULL);
  }
  nsvcd_body_free(piston, NULL);
}

// A piston goes through a thin plate where it starts, then turns into its cylinder, a hundredth of a
// millimetre from it all around; or the other way. The ends are looked at before all the rest.
static void asks_contacts_at_the_ends(void) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_cylinder(&shape, 0.1, 0.2, 300);
  const nsvcd_body *piston = asks_body(&shape, 0);
  memset(&shape, 0, sizeof shape);
  shapes_ring(&shape, 0.12, 0.10002, 0.2, 300);
  shapes_box_at(&shape, 0.05, 0, -0.4, 0.3, 0.03, 2e-5);
  const nsvcd_body *cylinder = asks_body(&shape, 0);
  for (int reversed = 0; reversed < 2; reversed++) {
    for (size_t count = 2; count < 201; count = 10 * count) {
      nsvcd_pose path[200];
      for (size_t n = 0; n < count; n++) {
        const double t = (double)(reversed ? count - 1 - n : n) / (double)(count - 1);
        path[n] = asks_pose(0, 0, 0.3 * t - 0.300005, 3 * t);
      }
      nsvcd_question question = question_of(piston, path, count, cylinder, NULL, NULL);
      const nsvcd_answer answer = asks(&question);
      // the plate has corners within the piston at the start
      CHECK_EQ(answer.verdict, NSVCD_HIT);
      CHECK_LE(answer.work, 9000);
    }
  }
  nsvcd_body_free(piston, NULL);
  nsvcd_body_free(cylinder, NULL);
}

// A box pressed into a table: who asks when they meet, how near they come, or with a skin that is
// less, is told which triangles do.
static void asks_names_what_meets_inside(void) {
  const nsvcd_body *table = asks_table(0, 1);
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, 0, 0, 0.05, 0.1, 0.1, 0.1);
  const nsvcd_body *box = asks_body(&shape, 0);
  const nsvcd_pose path[2] = {asks_pose(0, 0, -0.01, 0), asks_pose(0.2, 0, 0.1, 0)};
  for (int k = 0; k < 4; k++) {
    nsvcd_question question = question_of(box, path, 2, table, NULL, NULL);
    question.ask = k == 1 ? NSVCD_ASK_FIRST : k == 2 ? NSVCD_ASK_DISTANCE : NSVCD_ASK_HIT;
    question.to_time = k == 1 ? 0.01f : 0;
    question.to = k == 2 ? 0.01f : 0;
    question.slop = k == 3 ? 0.001f : 0;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_EQ(answer.nearest.time, 0);
    CHECK_EQ(answer.time.low, 0);
    CHECK_EQ(answer.inside, k == 0);
    CHECK_EQ(answer.nearest.triangle_a != NSVCD_NO_TRIANGLE, k > 0);
    CHECK(k == 0 || fabs((double)answer.nearest.point[2]) < 1e-4);
  }
  nsvcd_body_free(table, NULL);
  nsvcd_body_free(box, NULL);
}

// -------------------------------------------------------------------------------------------------
// first, in metres, and the poses that are safe

// How far some point of the last body goes on its way, as the other sees it, at least: `turn` is its angle
// about z, of which a tenth is left to the radius, `rises` the other's way up.
static double asks_way(const nsvcd_pose *path, double turn, double rises) {
  double square = 0;
  for (int k = 0; k < 3; k++) {
    const double step = (double)path[1].position[k] - (double)path[0].position[k];
    square += (step - (k == 2 ? rises : 0)) * (step - (k == 2 ? rises : 0));
  }
  return sqrt(square) + 0.9 * fabs(turn) * asks_reach;
}

// Is the answer as narrow as it was asked for, and are the bodies where it sends them free of each
// other, and not elsewhere than on their ways?
static void asks_check_first(const nsvcd_question *question, const nsvcd_answer *answer,
                             double way) {
  const double late = (double)answer->time.high - (double)answer->time.low;
  const double fraction = (double)answer->safe.time;
  CHECK_EQ(answer->verdict, NSVCD_HIT);
  // flat on flat it is wider than by its own measure, by what triangles are stored to
  CHECK(answer->why != NSVCD_WHY_WORK);
  CHECK(late > 0);
  if (question->to > 0) {
    const double quanta = (double)nsvcd_body_describe(question->a.body).quantization_error +
                          (double)nsvcd_body_describe(question->b.body).quantization_error;
    const double wider = answer->why == NSVCD_WHY_TOO_NEAR ? 2 * quanta : 0;
    CHECK_LE(late * way, 1.00001 * (double)question->to + wider);
  }
  if (question->to_time > 0) CHECK_LE(late, (double)question->to_time);
  CHECK(answer->safe.time <= answer->time.low);
  CHECK_LE((double)answer->time.low - (double)answer->safe.time, 2e-4 / way + 0.003);
  for (int k = 0; k < 2; k++) {
    const nsvcd_mover *mover = k ? &question->b : &question->a;
    const nsvcd_pose *safe = k ? &answer->safe.b : &answer->safe.a;
    const nsvcd_pose *last = mover->poses + mover->count - 1;
    for (int i = 0; i < 3; i++) {
      const double from = (double)mover->poses->position[i];
      const double place = from + fraction * ((double)last->position[i] - from);
      CHECK_NEAR((double)safe->position[i], place, 1e-6);
    }
  }
  asks_check_safe(question, answer);
}

// Does the convex hull of the contacts, seen from above, hold (x, y)? Then of the directions to them
// no two neighbours are half a turn apart. *widest_gap: between neighbours, radians.
static int asks_supports(const nsvcd_answer *answer, double x, double y, double *widest_gap) {
  double widest = 0;
  double angles[NSVCD_MAX_CONTACTS] = {0};
  const size_t count = answer->contact_count;
  if (count < 3) return 0;
  for (size_t n = 0; n < count; n++) {
    const float *p = answer->contacts[n].point;
    angles[n] = atan2((double)p[1] - y, (double)p[0] - x);
    for (size_t k = n; k > 0 && angles[k] < angles[k - 1]; k--) {
      const double swap = angles[k];
      angles[k] = angles[k - 1];
      angles[k - 1] = swap;
    }
  }
  for (size_t n = 0; n < count; n++) {
    const double next = n + 1 < count ? angles[n + 1] : angles[0] + 6.283185307179586;
    widest = fmax(widest, next - angles[n]);
  }
  *widest_gap = widest;
  return widest < 3.1416;
}

// What is set down flat, however it is turned, touches with points that hold it: on the table, each
// as near as was asked for, of a box its corners; and when it is set down again a little beside, the
// same, in the same order.
static void asks_manifold_holds(void) {
  const double to = 5e-4;
  shapes_rng rng = {2712};
  const nsvcd_body *tables[2] = {asks_table(0, 1), asks_table(0, 16)};
  size_t moved = 0;
  size_t same = 0;
  for (int n = 0; n < 2 * STANDING; n++) {
    const nsvcd_body *body = asks_standing(n % STANDING, &rng);
    for (int round = 0; round < 8; round++) {
      double x = shapes_uniform(&rng, -0.2, 0.2);
      double turn = shapes_uniform(&rng, 0, 6.28);
      uint32_t ids[NSVCD_MAX_CONTACTS] = {0};
      size_t count = 0;
      for (int again = 0; again < 3; again++, x += 1e-4, turn += 1e-3) {
        const nsvcd_pose path[2] = {asks_pose(x, 0.01, 0.03, turn),
                                    asks_pose(x, 0.01, -0.02, turn)};
        nsvcd_question question = question_of(body, path, 2, tables[round % 2], NULL, NULL);
        question.ask = NSVCD_ASK_FIRST;
        question.manifold = 1;
        question.to = (float)to;
        const nsvcd_answer answer = asks(&question);
        CHECK_EQ(answer.verdict, NSVCD_HIT);
        double gap = 7;
        CHECK(asks_supports(&answer, x, 0.01, &gap));
        // of a round base they stand all around
        if (n % STANDING < 7 && n % 2 == 0) CHECK_LE(gap, 1.9);
        int is_same = answer.contact_count == count;
        for (size_t k = 0; k < answer.contact_count; k++) {
          const nsvcd_contact *c = &answer.contacts[k];
          CHECK_NEAR(c->normal[2], 1, 1e-5);
          CHECK_LE(fabs((double)c->point[2]), 1.01 * to + 1e-5);
          CHECK_LE(c->gap, 1.01 * to + 1e-5);
          is_same &= c->id == ids[k];
          ids[k] = c->id;
        }
        if (again > 0) moved++;
        if (again > 0) same += (size_t)is_same;
        count = answer.contact_count;
        // a box has its corners
        for (size_t k = 0; n % STANDING > 7 && k < count; k++) {
          const float *p = answer.contacts[k].point;
          CHECK_NEAR(hypot((double)p[0] - x, (double)p[1] - 0.01), asks_corner, 1e-4);
        }
        if (n % STANDING > 7) CHECK_EQ(count, 4);
        const nsvcd_mover mover = question.a;
        question.a = question.b;
        question.b = mover;
        const nsvcd_answer swapped = asks(&question);
        CHECK_EQ(swapped.contact_count, answer.contact_count);
        for (size_t k = 0; k < swapped.contact_count; k++)
          CHECK_EQ(swapped.contacts[k].normal[2], -answer.contacts[k].normal[2]);
      }
    }
    nsvcd_body_free(body, NULL);
  }
  printf("  set down again, the same contacts: %zu of %zu\n", same, moved);
  CHECK_GE(same, moved * 9 / 10);
  nsvcd_body_free(tables[0], NULL);
  nsvcd_body_free(tables[1], NULL);
}

// A slim foot comes down, a triangle of which one corner is a little beside the line of the others,
// however it is turned: all three are told, and between which of the directions they are does not
// matter.
static void asks_manifold_of_what_is_slim(void) {
  const nsvcd_body *table = asks_table(0, 4);
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_cone(&shape, 0.1, 0.02, 0.05, 3);  // on three corners
  double low[3], high[3];
  shapes_bounds(&shape, low, high);
  for (size_t i = 0; i < shape.vertices; i++) {
    shape.positions[3 * i] *= 0.15;
    shape.positions[3 * i + 2] -= low[2];
  }
  const nsvcd_body *body = asks_body(&shape, 0);
  for (int n = 0; n < 90; n++) {
    const nsvcd_pose path[2] = {asks_pose(0.03, 0.02, 0.03, 0.07 * n),
                                asks_pose(0.03, 0.02, -0.02, 0.07 * n)};
    nsvcd_question question = question_of(body, path, 2, table, NULL, NULL);
    question.ask = NSVCD_ASK_FIRST;
    question.manifold = 1;
    question.to = 5e-4f;
    const nsvcd_answer answer = asks(&question);
    double area = 0;
    for (size_t k = 0; k < answer.contact_count; k++) {
      const float *a = answer.contacts[0].point;
      const float *b = answer.contacts[k].point;
      const float *c = answer.contacts[(k + 1) % answer.contact_count].point;
      area += fabs((double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))) / 2;
    }
    // of the whole: an equilateral triangle in a circle, pressed flat
    CHECK_NEAR(area, 0.75 * sqrt(3) * 0.01 * 0.15, 2e-5);
  }
  nsvcd_body_free(body, NULL);
  nsvcd_body_free(table, NULL);
}

// A finely cut plate comes down on the end of a post, or a post on a plate, so that corners of the
// plate's triangles are just beside the sides of the post: those are no contacts, but the corners of
// its end are.
static void asks_manifold_has_no_ghosts(void) {
  shapes_rng rng = {2714};
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 1, 1, 0.05, 16);
  const nsvcd_body *plate = asks_body(&shape, 0);
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 0.1, 0.1, 0.1, 1);
  const nsvcd_body *stump = asks_body(&shape, 0);
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 0.1, 0.1, 3, 1);
  const nsvcd_body *post = asks_body(&shape, 0);
  for (int k = 0; k < 200; k++) {
    const nsvcd_body *below = k % 2 ? post : plate;
    const nsvcd_body *above = k % 2 ? plate : k % 4 ? stump : post;
    const double height = 0.5 * (k % 2 ? 3.05 : k % 4 ? 0.15 : 3.05);
    // 1 / 16 is how far the plate's corners are from each other
    const double x = 1.0 / 16 - 0.05 - shapes_uniform(&rng, 0, 5e-4);
    const double side = k % 8 < 4 ? 1 : -1;
    // or it is in contact from the start
    const double from_height = k % 3 ? 0.01 : -3e-4;
    const nsvcd_pose path[2] = {asks_pose(side * x, 0.01, height + from_height, 0),
                                asks_pose(side * x, 0.01, height - 0.01, 0)};
    nsvcd_question question = question_of(above, path, 2, below, NULL, NULL);
    question.ask = NSVCD_ASK_FIRST;
    question.manifold = 1;
    question.to = 5e-4f;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.contact_count, 4);
    for (size_t n = 0; n < answer.contact_count; n++) {
      const nsvcd_contact *c = &answer.contacts[n];
      const double from = k % 2 ? 0 : side * x;
      const double across = k % 2 ? 0 : 0.01;
      CHECK_NEAR(c->normal[2], 1, 1e-5);
      CHECK_NEAR(fabs((double)c->point[0] - from), 0.05, 1e-4);
      CHECK_NEAR(fabs((double)c->point[1] - across), 0.05, 1e-4);
      if (n > 0) CHECK(c->id > c[-1].id);
    }
  }
  nsvcd_body_free(plate, NULL);
  nsvcd_body_free(stump, NULL);
  nsvcd_body_free(post, NULL);
}

// Deeper in a table than the skin is a contact as it is without one, with all its places.
static void asks_manifold_too_deep_for_a_skin(void) {
  shapes_rng rng = {2715};
  const nsvcd_body *table = asks_table(0, 16);
  for (int n = 0; n < STANDING; n++) {
    const nsvcd_body *body = asks_standing(n, &rng);
    const nsvcd_pose path[2] = {asks_pose(0.03, 0.01, -2e-3, 0.3),
                                asks_pose(0.03, 0.01, -0.02, 0.3)};
    nsvcd_question question = question_of(body, path, 2, table, NULL, NULL);
    question.ask = NSVCD_ASK_FIRST;
    question.manifold = 1;
    question.to = 5e-4f;
    const nsvcd_answer bare = asks(&question);
    question.slop = 1e-3f;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_EQ(answer.push_out[2], 0);
    CHECK_EQ(answer.contact_count, bare.contact_count);
    CHECK_EQ(memcmp(answer.contacts, bare.contacts, sizeof bare.contacts), 0);
    nsvcd_body_free(body, NULL);
  }
  nsvcd_body_free(table, NULL);
}

// Pressed into a table and sinking, with a skin for that: how near it comes is asked as well.
static void asks_safe_with_a_distance(void) {
  const nsvcd_body *tables[2] = {asks_table(0, 1), asks_table(0, 16)};
  shapes_rng rng = {2715};
  for (int n = 0; n < 4 * STANDING; n++) {
    const nsvcd_body *body = asks_standing(n % STANDING, &rng);
    const double depth = shapes_uniform(&rng, 0, 6e-4);
    const double x = shapes_uniform(&rng, -0.2, 0.2);
    const nsvcd_pose path[2] = {asks_pose(x, 0.01, -depth, 0.1 * n),
                                asks_pose(x + 0.01, 0.01, -depth - 1.2e-3, 0.1 * n)};
    nsvcd_question question = question_of(body, path, 2, tables[n % 2], NULL, NULL);
    question.slop = 2e-3f;
    question.ask = NSVCD_ASK_DISTANCE;
    question.to = n % 3 ? 1e-4f : 1e-3f;
    question.clearance = n % 4 > 1 ? 1e-4f : 0;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    asks_check_safe(&question, &answer);
    nsvcd_body_free(body, NULL);
  }
  nsvcd_body_free(tables[0], NULL);
  nsvcd_body_free(tables[1], NULL);
}

// Ask, go there, respond, ask again: what falls on a table and is pushed along it slides on, however
// coarsely it is asked, up to half of the skin; where it is sent it is free of the table, turned as
// it comes or flat, with a distance asked for as well.
static void asks_goes_on_for_frames(void) {
  const float shares[3] = {0.02f, 0.2f, 0.5f};
  const double frame = 1.0 / 60;
  const float skin = 1e-3f;
  shapes_rng rng = {2713};
  const nsvcd_body *tables[2] = {asks_table(0, 1), asks_table(0, 16)};
  for (int n = 0; n < STANDING; n++) {
    const nsvcd_body *body = asks_standing(n, &rng);
    for (int round = 0; round < 6; round++) {
      double speed[3] = {0.2, 0, -1};
      nsvcd_pose path[2] = {asks_pose(-0.3, 0, 0.01, 0.3 * n), asks_pose(0, 0, 0, 0)};
      nsvcd_question question = question_of(body, path, 2, tables[round % 2], NULL, NULL);
      question.ask = NSVCD_ASK_FIRST;
      question.manifold = 1;
      question.clearance = round % 2 ? 5e-4f : 0;
      question.slop = skin;
      question.to = shares[round / 2] * skin;
      for (int k = 0; k < 60; k++) {
        speed[2] -= 9.81 * frame;
        path[1] = path[0];
        for (int i = 0; i < 3; i++) path[1].position[i] += (float)(speed[i] * frame);
        const nsvcd_answer answer = asks(&question);
        CHECK(answer.depth <= skin);
        asks_check_safe(&question, &answer);
        if (k % 10 == 0) {
          nsvcd_question near_by = question;
          near_by.ask = NSVCD_ASK_DISTANCE;
          near_by.to = 1e-4f;
          near_by.manifold = 0;
          const nsvcd_answer apart = asks(&near_by);
          asks_check_safe(&near_by, &apart);
        }
        path[0] = answer.safe.a;
        for (size_t c = 0; c < answer.contact_count; c++) {
          const float *normal = answer.contacts[c].normal;
          double along = 0;
          for (int i = 0; i < 3; i++) along += speed[i] * (double)normal[i];
          for (int i = 0; i < 3 && along < 0; i++) speed[i] -= along * (double)normal[i];
        }
      }
      // what is left of a frame after a contact is lost
      CHECK_GE(path[0].position[0], -0.3 + 0.2 * 0.1);
      CHECK_LE(fabs((double)path[0].position[2]), 2e-3);
    }
    nsvcd_body_free(body, NULL);
  }
  nsvcd_body_free(tables[0], NULL);
  nsvcd_body_free(tables[1], NULL);
}

static void asks_first_is_to_metres(void) {
  static const float times[] = {0, 0.003f, 1e-5f, 5e-7f};  // the last as exact as floats are
  shapes_rng rng = {2711};
  const nsvcd_body *table = asks_table(0, 4);
  for (int n = 0; n < STANDING; n++) {
    const nsvcd_body *body = asks_standing(n, &rng);
    for (int round = 0; round < 12; round++) {
      const double turn = shapes_uniform(&rng, -1, 1);
      const double from = shapes_uniform(&rng, 0.1, 0.3);
      const nsvcd_pose path[2] = {
          asks_pose(0, 0, from, 0),
          asks_pose(shapes_uniform(&rng, -0.1, 0.1), 0, shapes_uniform(&rng, -0.3, -0.1), turn)};
      // the table comes up as well, by as much at most
      const nsvcd_pose rising[2] = {asks_pose(0, 0, 0, 0), asks_pose(0, 0, 0.5 * from, 0)};
      nsvcd_question question = question_of(body, path, 2, table, rising, NULL);
      question.b.count = round % 3 == 2 ? 2 : 1;
      question.ask = NSVCD_ASK_FIRST;
      question.clearance = round % 2 ? 0.002f : 0.0f;
      if (round % 4 < 3) question.to = round % 4 == 1 ? 10 : 0.0005f;
      question.to_time = times[round % 4];
      const double way = asks_way(path, turn, question.b.count > 1 ? 0.5 * from : 0);
      const nsvcd_answer answer = asks(&question);
      asks_check_first(&question, &answer, way);
      const nsvcd_mover a = question.a;
      question.a = question.b;
      question.b = a;
      const nsvcd_answer swapped = asks(&question);
      asks_check_first(&question, &swapped, way);
    }
    // what is not said: a thousandth of the smaller body
    const nsvcd_pose down[2] = {asks_pose(0, 0, 0.5, 0), asks_pose(0, 0, -0.5, 0)};
    nsvcd_question question = question_of(body, down, 2, table, NULL, NULL);
    question.ask = NSVCD_ASK_FIRST;
    const nsvcd_answer answer = asks(&question);
    const double to = (double)(NSVCD_DEFAULT_TO * nsvcd_body_describe(body).radius);
    const double late = (double)answer.time.high - (double)answer.time.low;
    CHECK_LE(late, to);
    CHECK_GE(late, 0.1 * to);
    nsvcd_body_free(body, NULL);
  }
  nsvcd_body_free(table, NULL);
}

// Ways so long, or so far from the world's origin, that a float of time or of a place is more than
// triangles are stored to: where they are sent they are free all the same, also set down.
static void asks_safe_of_long_ways(void) {
  shapes_rng rng = {54};
  const nsvcd_body *table = asks_table(0, 1);
  const nsvcd_body *box = asks_standing(9, &rng);
  for (int n = 0; n < 300; n++) {
    const int is_far = n % 2;
    const double way = pow(10, shapes_uniform(&rng, 0, 3.7));
    const double beyond = shapes_uniform(&rng, 0.005, 0.04);
    const double off = is_far ? shapes_uniform(&rng, -2000, 2000) : 0;
    const double turn = n % 3 ? 0.3 * n : 0;
    const nsvcd_pose rests = asks_pose(off, 0.3 * off, -0.7 * off, turn);
    const double up = (double)rests.position[2];
    const nsvcd_pose path[2] = {asks_pose(off, 0.3 * off, up + way, turn),
                                asks_pose(off, 0.3 * off, up - beyond, turn)};
    nsvcd_question question = question_of(box, path, 2, table, &rests, NULL);
    question.ask = NSVCD_ASK_FIRST;
    if (n % 5 == 0) question.to = 1e-6f;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK(answer.safe.time <= answer.time.low);
    if (answer.safe.time > 0) asks_check_safe(&question, &answer);
    // down to the table, pressed in, with a skin
    nsvcd_pose slides[2] = {path[0], path[0]};
    slides[0].position[2] = slides[1].position[2] = (float)(up - 5e-4);
    slides[1].position[0] += 0.1f;
    question.a.poses = slides;
    question.to = 0;
    question.slop = 5e-3f;
    const nsvcd_answer down = asks(&question);
    CHECK_EQ(down.verdict, NSVCD_FREE);
    asks_check_safe(&question, &down);
  }
  nsvcd_body_free(table, NULL);
  nsvcd_body_free(box, NULL);
}

// A box in a solid one, at its wall or not, with a skin or without: no lift off the wall takes it
// out, so it stays, and that is said.
static void asks_safe_inside(void) {
  shapes_mesh shapes[2];
  memset(shapes, 0, sizeof shapes);
  shapes_box(&shapes[0], 1, 1, 1, 1);
  shapes_box(&shapes[1], 0.1, 0.1, 0.1, 1);
  const nsvcd_body *solid = asks_body(&shapes[0], 0);
  const nsvcd_body *box = asks_body(&shapes[1], 0);
  size_t lifted = 0;
  for (int n = 0; n < 24; n++) {
    const double z = n % 2 ? 0 : -0.45 + 3e-5 * (n % 3);
    const nsvcd_pose path[2] = {asks_pose(0.1, 0, z, 0), asks_pose(0.2, 0, z, 0.1)};
    nsvcd_question question = question_of(box, path, 2, solid, NULL, NULL);
    question.ask = n / 8 == 0 ? NSVCD_ASK_HIT : n / 8 == 1 ? NSVCD_ASK_FIRST : NSVCD_ASK_DISTANCE;
    question.slop = n % 4 < 2 ? 2e-3f : 0;
    const nsvcd_answer answer = asks(&question);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    if (n % 2) CHECK_EQ(answer.inside, 1);
    lifted += answer.inside && asks_length(answer.push_out) > 0;
    CHECK_EQ(answer.safe.time, 0);
    CHECK_EQ(answer.depth, HUGE_VALF);
    CHECK_EQ(memcmp(&answer.safe.a, &path[0], sizeof path[0]), 0);
  }
  CHECK_GE(lifted, 1);
  nsvcd_body_free(solid, NULL);
  nsvcd_body_free(box, NULL);
}

// A way that is hardly longer than `to`, or shorter: some of what is free of it is known all the
// same, and that its start is.
static void asks_first_of_short_ways(void) {
  shapes_rng rng = {53};
  for (int n = 0; n < 100; n++) {
    const nsvcd_body *table = asks_table(0, n % 2 ? 16 : 1);
    const nsvcd_body *box = asks_standing(8 + n % 8, &rng);
    // what is told in float is off by 1.2e-7 of all lengths
    const double epsilon = 2.4e-7;
    const double way = epsilon * pow(10, shapes_uniform(&rng, 0.7, 2.5));
    const double fraction = shapes_uniform(&rng, 0.3, 0.9);
    const nsvcd_pose path[2] = {asks_pose(0.05, 0.02, 0.002 + fraction * way, 0.3),
                                asks_pose(0.05, 0.02, 0.002 - (1 - fraction) * way, 0.3)};
    const nsvcd_question question = {.a = {box, path, 2, NULL, 0},
                                     .b = {table, NULL, 0, NULL, 0},
                                     .ask = NSVCD_ASK_FIRST,
                                     .to = 1e-4f,
                                     .clearance = 0.002f};
    const nsvcd_answer answer = asks(&question);
    const double off = 1.5 * epsilon / way;
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_LE((double)answer.time.low, fraction + off);
    CHECK_GE((double)answer.time.high, fraction - off);
    if (way * fraction > 4 * epsilon) CHECK_EQ(answer.depth, 0);
    if (way > 16 * epsilon) CHECK_LE((double)(answer.time.high - answer.time.low), 0.2501 + off);
    if (way > 1e-5) asks_check_safe(&question, &answer);
    nsvcd_body_free(table, NULL);
    nsvcd_body_free(box, NULL);
  }
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// What has no area has no direction, however its corners are rounded.
static void asks_faces_without_area(void) {
  shapes_rng rng = {26};
  for (int trial = 0; trial < 10000; trial++) {
    nsvcd__d3 t[3];
    double d[3];
    const double size = pow(10, shapes_uniform(&rng, -9, 6));
    shapes_direction(&rng, d);
    t[0] = nsvcd__d3_of(size * shapes_uniform(&rng, -1, 1), size * shapes_uniform(&rng, -1, 1), 0);
    for (int k = 1; k < 3; k++) {
      const double way = size * shapes_uniform(&rng, -1, 1);
      t[k] = nsvcd__d3_add(t[0], nsvcd__d3_of(way * d[0], way * d[1], way * d[2]));
    }
    CHECK_EQ(nsvcd__d3_norm(nsvcd__face_direction(t)), 0);
  }
}

void test_asks(void) {
  RUN(asks_first_is_to_metres);
  RUN(asks_first_of_short_ways);
  RUN(asks_safe_of_long_ways);
  RUN(asks_safe_inside);
  RUN(asks_manifold_holds);
  RUN(asks_manifold_of_what_is_slim);
  RUN(asks_manifold_has_no_ghosts);
  RUN(asks_manifold_too_deep_for_a_skin);
  RUN(asks_safe_with_a_distance);
  RUN(asks_goes_on_for_frames);
  RUN(asks_skin_lifts_what_stands);
  RUN(asks_skin_in_a_corner);
  RUN(asks_skin_of_boxes_in_a_corner);
  RUN(asks_skin_under_a_ceiling);
  RUN(asks_skin_of_edge_on_edge);
  RUN(asks_depth_is_the_least);
  RUN(asks_skin_of_what_is_near);
  RUN(asks_measure_loses_nothing);
  RUN(asks_first_keeps_what_is_proven);
  RUN(asks_first_within_the_motion);
  RUN(asks_first_of_little_work);
  RUN(asks_contacts_at_the_ends);
  RUN(asks_names_what_meets_inside);
  // from within
  RUN(asks_faces_without_area);
}

CHECK_ALONE(test_asks)
