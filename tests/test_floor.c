// Floors of 20 m to 2 km, of twelve triangles or of thousands, and what stands 10 um to 10 mm over
// them, or is as deep in, slides, turns, tumbles, falls on them, or stands on them with a skin. What
// is right follows from the lowest vertex. `build/extremes` asks more of the same.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "floor_scene.h"
#include "question_of.h"
#include "check.h"

void test_floor(void);

static void *floor_workspace(void) {
  static void *memory;
  if (!memory) memory = malloc(nsvcd_sweep_workspace_size(NULL));
  if (!memory) exit(1);
  return memory;
}

#define PROPS 4
static const floor_prop *floor_props(void) {
  static floor_prop props[PROPS];
  if (props[0].body) return props;
  shapes_mesh shapes[PROPS];
  memset(shapes, 0, sizeof shapes);
  shapes_box(&shapes[0], 0.5, 0.4, 0.3, 1);
  shapes_mug(&shapes[1], 0.04, 0.1, 0.004, 16);
  shapes_chair(&shapes[2], 0.5, 0.9, 0.04);
  shapes_cone(&shapes[3], 0.2, 0.1, 0.3, 12);
  for (int n = 0; n < PROPS; n++) props[n] = floor_prop_of_shape(&shapes[n]);
  return props;
}

// Every act, over a floor.
static void floor_check(double half, int cells, double aside, double away, size_t count) {
  const floor_prop floor = floor_of(half, cells, 1, aside);
  const floor_prop *props = floor_props();
  floor_tally sum;
  shapes_rng rng = {46};
  memset(&sum, 0, sizeof sum);
  CHECK(floor.body != NULL);
  for (size_t i = 0; i < count; i++) {
    floor_scene s = floor_under(&floor, &props[shapes_pick(&rng, PROPS)], half, aside, away);
    floor_draw(&s, &rng, i);
    floor_ask(&s, floor_workspace(), nsvcd_sweep_workspace_size(NULL), 6, &sum);
  }
  CHECK_EQ(sum.wrong, 0);
  CHECK_EQ(sum.open, 0);
  nsvcd_body_free(floor.body, NULL);
  free(floor.vertices);
}

static void floor_of_twelve_triangles(void) {
  floor_check(10, 1, 0, 0, 80);
  floor_check(100, 1, 0, 0, 80);
  floor_check(1000, 1, 0, 0, 80);
}
static void floor_of_one_triangle(void) {
  floor_check(100, 0, 0, 0, 80);
}
static void floor_of_many_triangles(void) {
  floor_check(100, 4, 0, 0, 40);
  floor_check(1000, 30, 0, 0, 40);
}
static void floor_far_from_its_origin(void) {
  floor_check(100, 1, 1000, 0, 40);
  floor_check(100, 1, 0, 1000, 40);
  floor_check(100, 1, 0, 1e5, 40);
}

// A plate that slides flat over a floor, nearer than floats tell: its triangle pairs are not settled
// one by one, and the least distance is not sought in steps of the tolerance.
static void floor_flat_takes_little(void) {
  floor_prop floor = floor_of(10, 30, 1, 0);
  shapes_mesh shape;
  floor_tally sum;
  shapes_rng rng = {46};
  memset(&shape, 0, sizeof shape);
  memset(&sum, 0, sizeof sum);
  shapes_box(&shape, 4, 3, 0.5, 8);
  floor_prop plate = floor_prop_of_shape(&shape);
  CHECK(floor.body && plate.body);
  for (size_t i = 0; i < 24; i++) {
    floor_scene s = floor_under(&floor, &plate, 10, 0, 0);
    s.act = i % 2 ? FLOOR_MEASURED : FLOOR_SLIDES;
    s.gap = pow(10, -2 - (double)(i / 2 % 4));
    s.scale = 1;
    s.way = 0.5;
    s.is_tilted = i % 3 == 0;
    s.to = 1e-6;
    floor_make(&s, &rng);
    s.question.work = 30000;
    floor_ask(&s, floor_workspace(), nsvcd_sweep_workspace_size(NULL), 6, &sum);
  }
  CHECK_EQ(sum.wrong, 0);
  CHECK_EQ(sum.open, 0);
  floor_prop_free(&floor);
  floor_prop_free(&plate);
}

// A game's loop, 60 frames a second: a box of 0.5 m is pushed along a channel of 36 large triangles
// and against its walls, with 1.5 mm of room at either side, and slides all of the way.
static void floor_channel_is_slid_along(void) {
  const float frame = 1.0f / 60;
  shapes_mesh level, shape;
  memset(&level, 0, sizeof level);
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&level, 0, 0, -0.5, 10, 10, 1);
  for (int k = -1; k <= 1; k += 2)
    shapes_box_at(&level, k * (0.2515 + 0.15), 0, 1.0005, 0.3, 4, 1.999);
  shapes_box(&shape, 0.5, 0.5, 0.5, 1);
  floor_prop channel = floor_prop_of_shape(&level);
  floor_prop box = floor_prop_of_shape(&shape);
  CHECK(channel.body && box.body);
  for (int round = 0; round < 3; round++) {
    nsvcd_pose path[2] = {{{0, -1, 0.2512f}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
    const float push[3] = {(float)(round - 1) * 2 * frame, 0.5f, -9.81f * frame};
    float speed[3] = {0, 0, 0};
    nsvcd_question q = question_of(box.body, path, 2, channel.body, NULL, NULL);
    q.ask = NSVCD_ASK_FIRST;
    q.to = 5e-5f;
    q.clearance = 5e-4f;
    q.slop = 1e-3f;
    q.manifold = 1;
    for (int k = 0; k < 120; k++) {
      float left = 1;
      speed[1] = 0;
      for (int i = 0; i < 3; i++) speed[i] += push[i];
      for (int part = 0; part < 4 && left > 1e-3f; part++) {
        nsvcd_answer answer;
        path[1] = path[0];
        for (int i = 0; i < 3; i++) path[1].position[i] += left * frame * speed[i];
        CHECK_EQ(nsvcd_sweep(&q, floor_workspace(), nsvcd_sweep_workspace_size(NULL), &answer), 0);
        CHECK(answer.verdict != NSVCD_UNDECIDED);
        path[0] = answer.safe.a;
        left *= 1 - answer.safe.time;
        for (size_t c = 0; c < answer.contact_count; c++) {
          const float *n = answer.contacts[c].normal;
          const float along = speed[0] * n[0] + speed[1] * n[1] + speed[2] * n[2];
          for (int i = 0; i < 3 && along < 0; i++) speed[i] -= along * n[i];
        }
      }
    }
    CHECK_NEAR((double)path[0].position[1], 0, 0.02);
    CHECK_LE(fabs((double)path[0].position[0]), 0.0016);
    CHECK_NEAR((double)path[0].position[2], 0.25, 0.0021);
  }
  floor_prop_free(&channel);
  floor_prop_free(&box);
}

// A box slides over a floor, both of many triangles, as far above it as its clearance, and its skin
// is the same: it is lifted off by no more than a float tells, and that takes no look at each pair of
// triangles.
static void floor_clearance_is_the_gap(void) {
  floor_prop floor = floor_of(0.5, 12, 0.1, 0);
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 0.3, 0.3, 0.25, 8);
  floor_prop box = floor_prop_of_shape(&shape);
  CHECK(floor.body && box.body);
  for (int round = 0; round < 6; round++) {
    const float turn = 0.13f * (float)round;
    const float gap = round % 2 ? 2e-4f : 1e-3f;
    nsvcd_pose path[2] = {{{-0.05f, 0.01f, 0.125f}, {0, 0, sinf(turn), cosf(turn)}}};
    nsvcd_question q = question_of(box.body, path, 2, floor.body, NULL, NULL);
    nsvcd_answer answer;
    path[0].position[2] += gap;
    path[1] = path[0];
    path[1].position[0] = 0.05f;
    q.clearance = q.slop = gap;
    CHECK_EQ(nsvcd_sweep(&q, floor_workspace(), nsvcd_sweep_workspace_size(NULL), &answer), 0);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    CHECK_LE(answer.work, 1000);
  }
  floor_prop_free(&floor);
  floor_prop_free(&box);
}

// Floors that slope in their own mesh, whose coarse copies are on no plane: what stands on them, or
// in them, slides over them, turns or falls, by more than floats say where the floor is.
static void floor_slopes_in_its_mesh(void) {
  const floor_prop *props = floor_props();
  shapes_rng rng = {47};
  for (size_t i = 0; i < check_many(96); i++) {
    const double half = i % 3 ? (i % 3 == 1 ? 10 : 100) : 1000;
    const floor_prop *prop = &props[shapes_pick(&rng, PROPS)];
    const int falls = i % 4 == 3;
    const double least = 1e-6 * half;
    const double gap = least * pow(10, shapes_uniform(&rng, 0, 2)) * (i / 4 % 2 || falls ? 1 : -1);
    const double turn = i % 4 == 2 ? 1 : 0;
    double low = 0;
    double q[4], m[9], at[3];
    oracle_pose pose;
    nsvcd_pose path[2];
    nsvcd_answer answer;
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    shapes_box(&shape, 2 * half, 2 * half, 1, i / 12 % 2 ? 7 : 1);
    shapes_place(&shape, 0, NULL, 0, 0, -0.5);
    shapes_quaternion(&rng, q);
    shapes_place(&shape, 0, q, 0, 0, 0);
    floor_prop floor = floor_prop_of_shape(&shape);
    oracle_matrix(q, m);
    for (size_t n = 0; n < prop->count; n++) low = fmin(low, prop->vertices[3 * n + 2]);
    for (int k = 0; k < 2; k++) at[k] = half * shapes_uniform(&rng, -0.4, 0.4);
    for (int end = 0; end < 2; end++) {
      const double sine = sin(0.5 * turn * end);
      const double cosine = cos(0.5 * turn * end);
      at[2] = gap - low + (falls ? (end ? -2 * gap : 0.5) : 0);
      at[0] += end && i % 4 == 1 ? 0.3 : 0;
      for (int k = 0; k < 3; k++)
        pose.position[k] = m[3 * k] * at[0] + m[3 * k + 1] * at[1] + m[3 * k + 2] * at[2];
      for (int k = 0; k < 4; k++)  // about its own z, then q
        pose.rotation[k] = q[k] * cosine + (k % 2 ? -1 : 1) * q[k ^ 1] * sine;
      path[end] = pose_rounded(&pose);
    }
    nsvcd_question question = question_of(prop->body, path, i % 4 ? 2 : 1, floor.body, NULL, NULL);
    question.ask = falls ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
    question.to = falls ? (float)least : 0;
    CHECK_EQ(nsvcd_sweep(&question, floor_workspace(), nsvcd_sweep_workspace_size(NULL), &answer),
             0);
    CHECK_EQ(answer.verdict, gap < 0 || falls ? NSVCD_HIT : NSVCD_FREE);
    if (falls) {
      const double way = 0.5 + 2 * gap;
      CHECK_NEAR(way * (double)answer.time.low, 0.5 + gap, 3 * least);
      CHECK_NEAR(way * (double)answer.time.high, 0.5 + gap, 3 * least);
    }
    floor_prop_free(&floor);
  }
}

void test_floor(void) {
  RUN(floor_of_twelve_triangles);
  RUN(floor_of_one_triangle);
  RUN(floor_of_many_triangles);
  RUN(floor_far_from_its_origin);
  RUN(floor_slopes_in_its_mesh);
  RUN(floor_flat_takes_little);
  RUN(floor_channel_is_slid_along);
  RUN(floor_clearance_is_the_gap);
}

CHECK_ALONE(test_floor)
