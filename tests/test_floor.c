// Floors of 20 m to 2 km, of twelve triangles or of thousands, and what stands 10 um to 10 mm over
// them, or is as deep in, slides, turns, tumbles, falls on them, or stands on them with a skin. What
// is right follows from the lowest vertex. `build/extremes` asks more of the same.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "floor_scene.h"
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
  for (int n = 0; n < PROPS; n++) props[n] = floor_prop_of_shape(&shapes[n], 1);
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
  const floor_prop floor = floor_of(10, 30, 1, 0);
  shapes_mesh shape;
  floor_tally sum;
  shapes_rng rng = {46};
  memset(&shape, 0, sizeof shape);
  memset(&sum, 0, sizeof sum);
  shapes_box(&shape, 4, 3, 0.5, 8);
  const floor_prop plate = floor_prop_of_shape(&shape, 1);
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
  nsvcd_body_free(floor.body, NULL);
  nsvcd_body_free(plate.body, NULL);
  free(plate.vertices);
  free(floor.vertices);
}

void test_floor(void) {
  RUN(floor_of_twelve_triangles);
  RUN(floor_of_one_triangle);
  RUN(floor_of_many_triangles);
  RUN(floor_far_from_its_origin);
  RUN(floor_flat_takes_little);
}

CHECK_ALONE(test_floor)
