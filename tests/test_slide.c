// Frames of bodies in a world: does nothing ever overlap, does what slides go its way, does what rests
// stay? Against distances in double by the oracle, and sums on paper.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../extras/neuralsvcd_world.h"

#include "world_scene.h"

void test_slide(void);

#define FRAME (1.0f / 60)
#define NEAR 0.0005f  // the clearance and the margin of most bodies
#define REST (2 * (double)NEAR)
// It is set down at the clearance and the margin, and left there down to a quarter of the margin.
#define CHECK_RESTS(gap) CHECK_NEAR(gap, 1.625 * (double)NEAR, 0.375 * (double)NEAR + 2e-5)
static const float gravity = 9.81f / 60;

// A body that is moved, and what has become of it.
typedef struct actor {
  stage *at;
  size_t id;
  nsvcd_slide_options options;
  nsvcd_velocity velocity;
  nsvcd_slide_answer answer;
  // over all frames: the least distance from others, and how many frames it rested, overlapped, was caught
  double least, spent;
  int rested, overlaps, caught;
} actor;

static actor actor_of(stage *s, size_t id) {
  actor out;
  memset(&out, 0, sizeof out);
  out.at = s;
  out.id = id;
  out.options.clearance = out.options.margin = NEAR;
  out.least = HUGE_VAL;
  out.spent = 1;
  return out;
}
// A cube of a half metre and a kilogram.
static actor prop_of(stage *s, size_t id, float friction) {
  actor out = actor_of(s, id);
  out.options.mass = 1;
  for (int k = 0; k < 3; k++) out.options.inertia[k] = 1.0f / 24;
  out.options.friction = friction;
  return out;
}
static actor character_of(stage *s, size_t id, float step) {
  actor out = actor_of(s, id);
  out.options.up[2] = 1;
  out.options.step = step;
  return out;
}
static void slide(actor *a) {
  size_t size;
  void *memory = workspace(&size);
  CHECK_EQ(nsvcd_world_slide(a->at->world, a->id, &a->options, FRAME, memory, size, &a->velocity,
                             &a->answer),
           NSVCD_OK);
  a->rested += a->answer.rests;
  a->caught += a->answer.caught != NSVCD_NOBODY;
  a->spent = fmin(a->spent, (double)a->answer.spent);
}
static void look(actor *a) {
  const double d = stage_apart(a->at, a->id);
  a->least = fmin(a->least, d);
  a->overlaps += d < 0;
}
// A frame with gravity, at a horizontal speed or, where that is NaN, at its own.
static void frame(actor *a, float x, float y) {
  a->velocity.linear[2] -= gravity;
  if (x <= 1e6f) a->velocity.linear[0] = x;
  if (y <= 1e6f) a->velocity.linear[1] = y;
  slide(a);
  CHECK_EQ(nsvcd_world_arrive(a->at->world), NSVCD_OK);
  look(a);
}
#define ITS_OWN 2e6f
static void keeps_clear(const actor *a) {
  CHECK_EQ(a->overlaps, 0);
  CHECK_EQ(a->caught, 0);
  CHECK_GE(a->least, (double)a->options.clearance - 1e-5);
}
static double place(const actor *a, int axis) {
  return (double)stage_pose(a->at, a->id).position[axis];
}
static double moved(const nsvcd_pose *a, const nsvcd_pose *b) {
  double most = 0;
  for (int k = 0; k < 3; k++)
    most = fmax(most, fabs((double)a->position[k] - (double)b->position[k]));
  for (int k = 0; k < 4; k++)
    most = fmax(most, fabs((double)a->rotation[k] - (double)b->rotation[k]));
  return most;
}
static size_t add_floor(stage *s) {
  return stage_add(s, thing_box(10, 10, 1), pose_of(0, 0, -0.5), 1);
}
static size_t add_cube(stage *s, double x, double y, double z) {
  return stage_add(s, thing_box(0.5, 0.5, 0.5), pose_of(x, y, z), 0);
}
// Walls of 30 cm, beside a cube in the middle, so far from it.
static void add_walls(stage *s, double right, double left) {
  if (right > 0) stage_add(s, thing_box(0.3, 6, 2), pose_of(0.25 + 0.15 + right, 0, 1.001), 1);
  if (left > 0) stage_add(s, thing_box(0.3, 6, 2), pose_of(-0.25 - 0.15 - left, 0, 1.001), 1);
}

// ---- along walls

static void slides_along(double right, double left, float push, double above) {
  for (int kind = 0; kind < 2; kind++) {
    stage s = stage_begin();
    add_floor(&s);
    add_walls(&s, right, left);
    if (above > 0) stage_add(&s, thing_box(10, 10, 1), pose_of(0, 0, 1.0 + above), 1);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = kind ? prop_of(&s, id, 0) : character_of(&s, id, 0.1f);
    for (int f = 0; f < 300; f++) {
      const double before = place(&a, 1);
      frame(&a, push, 0.5f);
      CHECK_NEAR(place(&a, 1) - before, 0.5 * (double)FRAME, 1e-5);
    }
    keeps_clear(&a);
    CHECK_NEAR(place(&a, 1), 2.5, 1e-3);
    CHECK_GE(a.spent, 0.999);
    if (above <= 0) CHECK_RESTS(place(&a, 2) - 0.25);
    stage_end(&s);
  }
}
static void on_a_floor_at_full_speed(void) {
  slides_along(0, 0, 0, 0);
}
static void along_a_wall_at_full_speed(void) {
  slides_along(0.0012, 0, 2, 0);
  slides_along(0.0012, 0, 0.1f, 0);
}
static void along_a_slot_at_full_speed(void) {
  slides_along(0.0015, 0.0015, 1, 0);
  slides_along(0.0006, 0.0006, 1, 0);
}
static void below_a_ceiling_at_full_speed(void) {
  slides_along(0, 0, 0, 0.003);
}

// One body of floor and walls: the same.
static void along_walls_of_one_body(void) {
  for (int kind = 0; kind < 2; kind++) {
    stage s = stage_begin();
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    shapes_box_at(&shape, 0, 0, -0.5, 10, 10, 1);
    shapes_box_at(&shape, 0.25 + 0.15 + 0.0015, 0, 1.001, 0.3, 6, 2);
    stage_add(&s, thing_of(&shape), pose_of(0, 0, 0), 1);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = kind ? prop_of(&s, id, 0) : character_of(&s, id, 0.1f);
    for (int f = 0; f < 300; f++) frame(&a, 1, 0.5f);
    keeps_clear(&a);
    CHECK_NEAR(place(&a, 1), 2.5, 1e-3);
    CHECK_RESTS(0.0015 - place(&a, 0));
    stage_end(&s);
  }
}

static void into_a_corner_and_stays(void) {
  for (int kind = 0; kind < 3; kind++) {
    stage s = stage_begin();
    add_floor(&s);
    stage_add(&s, thing_box(0.3, 6, 2), pose_of(0.8, 0, 1.001), 1);
    stage_add(&s, thing_box(6, 0.3, 2), pose_of(0.05, 3.2, 1.001), 1);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = kind ? prop_of(&s, id, kind == 2 ? 0 : 0.5f) : character_of(&s, id, 0.1f);
    for (int f = 0; f < 120; f++) frame(&a, 3, 4);
    const nsvcd_pose there = stage_pose(&s, id);
    for (int f = 0; f < 120; f++) frame(&a, 3, 4);
    const nsvcd_pose now = stage_pose(&s, id);
    keeps_clear(&a);
    // without friction what pushes by 5 m/s in each frame is not quite without a moment
    CHECK_LE(moved(&there, &now), kind == 2 ? 1e-4 : 1e-6);
    CHECK_RESTS(0.65 - 0.25 - place(&a, 0));
    CHECK_RESTS(3.05 - 0.25 - place(&a, 1));
    stage_end(&s);
  }
}

// ---- at rest

static void what_is_dropped_comes_to_rest(void) {
  for (int kind = 0; kind < 3; kind++) {
    stage s = stage_begin();
    add_floor(&s);
    const size_t id = add_cube(&s, 0, 0, 1.25);
    actor a = kind == 2 ? actor_of(&s, id)
              : kind    ? prop_of(&s, id, 0.5f)
                        : character_of(&s, id, 0.1f);
    for (int f = 0; f < 120; f++) frame(&a, ITS_OWN, ITS_OWN);
    CHECK_RESTS(place(&a, 2) - 0.25);
    const nsvcd_pose there = stage_pose(&s, id);
    a.rested = 0;
    for (int f = 0; f < 300; f++) frame(&a, ITS_OWN, ITS_OWN);
    const nsvcd_pose now = stage_pose(&s, id);
    CHECK_LE(moved(&there, &now), 1e-6);
    CHECK_GE(a.rested, 299);
    keeps_clear(&a);
    stage_end(&s);
  }
}

// Rests the same whether its last answer is handed back or not; and wakes when what it stands on goes.
static void what_rested_rests_again(void) {
  for (int how = 0; how < 4; how++) {
    stage s = stage_begin();
    const size_t floor = add_floor(&s);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    const size_t above = add_cube(&s, 0.1, 0, 0.7524);
    actor a[2] = {prop_of(&s, id, 0.5f), prop_of(&s, above, 0.5f)};
    for (int f = 0; f < 120; f++) {
      for (int k = 0; k < 2; k++) frame(&a[k], ITS_OWN, ITS_OWN);
    }
    for (int k = 0; k < 2; k++) {
      actor other = a[k];
      memset(&other.answer, 0, sizeof other.answer);
      other.velocity.linear[2] -= gravity;
      a[k].velocity.linear[2] -= gravity;
      slide(&other);
      slide(&a[k]);
      CHECK_EQ(a[k].answer.rests, 1);
      CHECK_EQ(a[k].answer.questions, 0);
      CHECK_EQ(other.answer.rests, 1);
      CHECK(!memcmp(&a[k].answer.pose, &other.answer.pose, sizeof other.answer.pose));
      CHECK(!memcmp(&a[k].velocity, &other.velocity, sizeof other.velocity));
      CHECK_EQ(a[k].answer.contact_count, other.answer.contact_count);
      CHECK_EQ(a[k].answer.ground, other.answer.ground);
    }
    const nsvcd_pose lower = pose_of(0, 0, -0.6);
    const nsvcd_pose aside = pose_of(0, 3, 0.2512);
    if (how == 0) stage_remove(&s, floor);
    if (how == 1) CHECK_EQ(nsvcd_world_move(s.world, floor, &lower), NSVCD_OK);
    if (how == 2) CHECK_EQ(nsvcd_world_move(s.world, id, &aside), NSVCD_OK);
    if (how == 3) CHECK_EQ(nsvcd_world_drive(s.world, floor, &lower), NSVCD_OK);
    const double was = place(&a[1], 2);
    for (int k = 0; k < 2; k++) frame(&a[k], ITS_OWN, ITS_OWN);
    for (int k = 0; k < 2; k++) CHECK_EQ(a[k].overlaps, 0);
    CHECK_LE(place(&a[1], 2), was - 0.002);
    stage_end(&s);
  }
}

// A slope of 20 degrees holds by a friction above its tangent, 0.364.
static void friction_on_a_slope(void) {
  static const double by = 0.349065850399;
  for (int kind = 0; kind < 2; kind++) {
    stage s = stage_begin();
    stage_add(&s, thing_box(20, 4, 1), turned(-0.5 * sin(by), 0, -0.5 * cos(by), 1, by), 1);
    const double high = 0.25 + REST;
    nsvcd_pose pose = turned(high * sin(by), 0, high * cos(by), 1, by);
    const size_t id = stage_add(&s, thing_box(0.5, 0.5, 0.5), pose, 0);
    actor a = prop_of(&s, id, kind ? 0.1f : 0.5f);
    for (int f = 0; f < 60; f++) frame(&a, ITS_OWN, ITS_OWN);
    const nsvcd_pose there = stage_pose(&s, id);
    if (kind == 0) {
      CHECK_LE(moved(&there, &pose), 1e-3);
      for (int f = 0; f < 240; f++) frame(&a, ITS_OWN, ITS_OWN);
      const nsvcd_pose now = stage_pose(&s, id);
      CHECK_LE(moved(&there, &now), 1e-6);
    } else {
      const double gone =
          hypot(place(&a, 0) - (double)pose.position[0], place(&a, 2) - (double)pose.position[2]);
      const double pulls = 9.81 * (sin(by) - 0.1 * cos(by));
      CHECK_NEAR(gone, 0.5 * pulls * 61.0 / 60, 0.02);
    }
    keeps_clear(&a);
    stage_end(&s);
  }
}

static void what_falls_bounces(void) {
  for (int kind = 0; kind < 3; kind++) {
    const double share = 0.5 * kind;
    stage s = stage_begin();
    add_floor(&s);
    const size_t id = add_cube(&s, 0, 0, 1.25 + REST);
    actor a = prop_of(&s, id, 0.5f);
    a.options.restitution = (float)share;
    double top = 0;
    int has_hit = 0;
    for (int f = 0; f < 90; f++) {
      frame(&a, ITS_OWN, ITS_OWN);
      has_hit |= place(&a, 2) < 0.35;
      if (has_hit && a.velocity.linear[2] > 0) top = fmax(top, place(&a, 2));
    }
    keeps_clear(&a);
    if (kind == 0) CHECK_LE(top, 0.36);
    if (kind > 0) CHECK_NEAR(top - 0.25 - REST, share * share, 0.12 * share);
    stage_end(&s);
  }
}

static void a_stack_of_ten_stands(void) {
  enum { TALL = 10 };
  stage s = stage_begin();
  actor a[TALL];
  nsvcd_pose begins[TALL];
  add_floor(&s);
  for (int k = 0; k < TALL; k++) {
    const size_t id = add_cube(&s, 0.02 * (k % 2), 0, 0.25 + 0.0012 + 0.5012 * k);
    a[k] = prop_of(&s, id, 0.5f);
  }
  for (int f = 0; f < 300; f++) {
    for (int k = 0; k < TALL; k++) {
      a[k].velocity.linear[2] -= gravity;
      slide(&a[k]);
    }
    for (int k = 0; k < TALL && f % 20 == 0; k++) look(&a[k]);
    for (int k = 0; k < TALL && f == 60; k++) begins[k] = stage_pose(&s, a[k].id);
  }
  for (int k = 0; k < TALL; k++) {
    const nsvcd_pose now = stage_pose(&s, a[k].id);
    keeps_clear(&a[k]);
    CHECK_LE(moved(&begins[k], &now), 1e-6);
    const double below = k ? (double)stage_pose(&s, a[k - 1].id).position[2] : -0.25;
    CHECK_NEAR((double)now.position[2] - below - 0.5, 1.5 * (double)NEAR, 0.6 * (double)NEAR);
    CHECK_NEAR(now.position[0], 0.02 * (k % 2), 1e-3);
  }
  stage_end(&s);
}

// ---- driven bodies

static void rides_elevators(void) {
  static const float speeds[3] = {1, 2, 20};
  for (int run = 0; run < 6; run++) {
    const float speed = speeds[run / 2];
    stage s = stage_begin();
    const size_t lift = add_floor(&s);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = run % 2 ? prop_of(&s, id, 0.5f) : character_of(&s, id, 0.1f);
    for (int f = 0; f < 120; f++) {
      nsvcd_pose to = stage_pose(&s, lift);
      to.position[2] += (f / 60 % 2 ? -speed : speed) * FRAME;
      CHECK_EQ(nsvcd_world_drive(s.world, lift, &to), NSVCD_OK);
      frame(&a, ITS_OWN, ITS_OWN);
      const double high = place(&a, 2) - (double)stage_pose(&s, lift).position[2] - 0.5;
      if (f < 60) CHECK_NEAR(high, 0.25 + REST, 2e-3);
      if (f > 60 && speed < 5 && run % 2 == 0) CHECK_LE(high, 0.25 + 0.4);
    }
    keeps_clear(&a);
    CHECK_NEAR(place(&a, 0), 0, 1e-4);
    stage_end(&s);
  }
}

// As a level has it: on the floor to the bit, or by less than a clearance in it. What is deeper stays.
static void what_touches_at_first_gets_away(void) {
  static const double gaps[] = {1e-6, 0, -1e-7, -1e-6, -1e-5, -1e-4, -7e-4, -5e-3};
  enum { GAPS = sizeof gaps / sizeof *gaps };
  for (int kind = 0; kind < 3 * GAPS; kind++) {
    const double gap = gaps[kind / 3];
    stage s = stage_begin();
    add_floor(&s);
    const size_t id = add_cube(&s, 0, 0, 0.25 + gap);
    actor a = kind % 3 ? prop_of(&s, id, kind % 3 == 2 ? 0.5f : 0) : character_of(&s, id, 0.1f);
    for (int f = 0; f < 10; f++) frame(&a, 0.5f, 0);
    if (gap > -1e-3) {
      CHECK_GE(stage_apart(&s, id), (double)NEAR - 1e-5);
      CHECK_GE(place(&a, 0), 0.06);  // of 0.083
    } else {
      CHECK_EQ(place(&a, 0), 0);
      CHECK_EQ(a.spent, 0);
    }
    stage_end(&s);
  }
}

// Kinds 2 and 3 are held by walls within its clearance: told is the lift, which they cannot get away from.
static void is_caught_below_a_ceiling(void) {
  for (int kind = 0; kind < 4; kind++) {
    stage s = stage_begin();
    if (kind > 1) add_walls(&s, 0.4 * NEAR, 0.4 * NEAR);
    const size_t lift = add_floor(&s);
    stage_add(&s, thing_box(10, 10, 1), pose_of(0, 0, 1.5), 1);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = kind % 2 ? prop_of(&s, id, 0.5f) : character_of(&s, id, 0.1f);
    int f = 0;
    for (; f < 120 && !a.answer.caught; f++) {
      CHECK_EQ(a.overlaps, 0);
      nsvcd_pose to = stage_pose(&s, lift);
      to.position[2] += 1.0f * FRAME;
      CHECK_EQ(nsvcd_world_drive(s.world, lift, &to), NSVCD_OK);
      frame(&a, ITS_OWN, ITS_OWN);
    }
    // the floor comes as high as 0.5 less both distances
    CHECK_EQ(a.answer.caught, lift);
    CHECK_NEAR(f, kind > 1 ? 1 : 30, 1);
    stage_end(&s);
  }
}

static void rides_turntables(void) {
  for (int kind = 0; kind < 2; kind++) {
    stage s = stage_begin();
    const size_t table = add_floor(&s);
    const size_t id = add_cube(&s, 1.5, 0, 0.2512);
    actor a = kind ? prop_of(&s, id, 0.5f) : character_of(&s, id, 0.1f);
    double radius = 0;
    double behind = 0;
    for (int f = 0; f < 300; f++) {
      const nsvcd_pose to = turned(0, 0, -0.5, 2, 0.02 * (f + 1));
      CHECK_EQ(nsvcd_world_drive(s.world, table, &to), NSVCD_OK);
      frame(&a, ITS_OWN, ITS_OWN);
      const double far_off = hypot(place(&a, 0), place(&a, 1));
      const double lag =
          remainder(0.02 * (f + 1) - atan2(place(&a, 1), place(&a, 0)), 6.283185307179586);
      if (f == 60) {
        radius = far_off;
        behind = lag;
      }
      if (f > 60) CHECK_NEAR(far_off, radius, 0.02);
      if (f > 60) CHECK_NEAR(lag, behind, 0.01);
    }
    keeps_clear(&a);
    // a prop slips until friction has brought it to 1.8 m/s, by 4.9 m/s^2
    CHECK_NEAR(radius, 1.5, kind ? 0.1 : 0.01);
    CHECK_NEAR(behind, kind ? 1.8 * 1.8 / (2 * 0.5 * 9.81) / 1.5 : 0, kind ? 0.03 : 1e-3);
    stage_end(&s);
  }
}

static void a_door_pushes(void) {
  static const double rates[4] = {0.01, 0.025, 0.05, 0.2};
  for (int run = 0; run < 8; run++) {
    const double rate = rates[run / 2];
    stage s = stage_begin();
    nsvcd_world_body door;
    memset(&door, 0, sizeof door);
    add_floor(&s);
    door.pose = pose_of(0.5, 0, 1.01);
    door.pivot[0] = -0.5f;
    const size_t hinged = stage_add_body(&s, thing_box(1, 0.05, 2), door);
    const size_t id = add_cube(&s, 0.7, 0.5, 0.2512);
    actor a = run % 2 ? prop_of(&s, id, 0.3f) : character_of(&s, id, 0.1f);
    for (int f = 0; f * rate < 1.5; f++) {
      const double angle = fmin(rate * (f + 1), 1.5);
      const nsvcd_pose to = turned(0.5 * cos(angle), 0.5 * sin(angle), 1.01, 2, angle);
      CHECK_EQ(nsvcd_world_drive(s.world, hinged, &to), NSVCD_OK);
      frame(&a, ITS_OWN, ITS_OWN);
    }
    keeps_clear(&a);
    CHECK_LE(place(&a, 0), 0.45);
    CHECK_NEAR(place(&a, 2), 0.25 + REST, 1e-3);
    stage_end(&s);
  }
}

// ---- characters

static void climbs_steps_and_goes_down(void) {
  for (int tall = 0; tall < 2; tall++) {
    stage s = stage_begin();
    const double step = tall ? 0.3 : 0.1;
    add_floor(&s);
    stage_add(&s, thing_box(2, 10, step), pose_of(2, 0, 0.5 * step), 1);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = character_of(&s, id, 0.2f);
    for (int f = 0; f < 120; f++) {
      frame(&a, 1, 0);
      CHECK(a.answer.ground != NSVCD_NOBODY);
    }
    keeps_clear(&a);
    CHECK_NEAR(place(&a, 0), tall ? 0.75 - REST : 2, 2e-3);
    CHECK_NEAR(place(&a, 2), 0.25 + REST + (tall ? 0 : step), 1e-3);
    for (int f = 0; f < 120; f++) {
      frame(&a, -1, 0);
      CHECK(a.answer.ground != NSVCD_NOBODY);
    }
    keeps_clear(&a);
    CHECK_NEAR(place(&a, 0), tall ? 0.75 - REST - 2 : 0, 2e-3);
    CHECK_NEAR(place(&a, 2), 0.25 + REST, 1e-3);
    stage_end(&s);
  }
}

// Walks as fast up 30 degrees as on the level, and not up 60; stands still there, and walks down.
static void walks_on_slopes(void) {
  for (int steep = 0; steep < 2; steep++) {
    stage s = stage_begin();
    const double by = steep ? 1.047197551 : 0.523598776;
    add_floor(&s);
    // its upper face begins at x = 1 on the floor
    const nsvcd_pose pose =
        turned(1 + 3 * cos(by) + 0.5 * sin(by), 0, 3 * sin(by) - 0.5 * cos(by), 1, -by);
    stage_add(&s, thing_box(6, 6, 1), pose, 1);
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = character_of(&s, id, 0.2f);
    for (int f = 0; f < 180; f++) frame(&a, 1, 0);
    keeps_clear(&a);
    if (steep) {
      CHECK_LE(place(&a, 0), 1 - 0.25);
      CHECK_LE(place(&a, 2), 0.30);
    } else {
      CHECK_NEAR(place(&a, 0), 3, 5e-3);
      CHECK_GE(place(&a, 2), 1);
      const nsvcd_pose there = stage_pose(&s, id);
      for (int f = 0; f < 60; f++) frame(&a, 0, 0);
      const nsvcd_pose now = stage_pose(&s, id);
      CHECK_LE(moved(&there, &now), 1e-3);
      for (int f = 0; f < 60; f++) frame(&a, 0, 0);
      const nsvcd_pose then = stage_pose(&s, id);
      CHECK_LE(moved(&now, &then), 1e-6);
      for (int f = 0; f < 180; f++) frame(&a, -1, 0);
      CHECK_NEAR(place(&a, 0), 0, 1e-2);
      CHECK_NEAR(place(&a, 2), 0.25 + REST, 1e-3);
    }
    keeps_clear(&a);
    stage_end(&s);
  }
}

// In the air, who walks into a slope of 60 degrees slides down it.
static void does_not_rise_along_a_steep_slope(void) {
  stage s = stage_begin();
  const double by = 1.047197551;
  const nsvcd_pose pose =
      turned(1 + 3 * cos(by) + 0.5 * sin(by), 0, 3 * sin(by) - 0.5 * cos(by), 1, -by);
  add_floor(&s);
  stage_add(&s, thing_box(6, 6, 1), pose, 1);
  const size_t id = add_cube(&s, 1.2, 0, 2.3);
  actor a = character_of(&s, id, 0.2f);
  double high = 2.3;
  for (int f = 0; f < 180; f++) {
    frame(&a, 1, 0.1f);
    CHECK_LE(place(&a, 2), fmax(high, 0.25 + REST));
    high = place(&a, 2);
  }
  keeps_clear(&a);
  CHECK_NEAR(place(&a, 2), 0.25 + REST, 1e-3);
  CHECK_NEAR(place(&a, 1), 0.3, 1e-3);
  stage_end(&s);
}

static void does_not_step_below_a_low_ceiling(void) {
  stage s = stage_begin();
  add_floor(&s);
  stage_add(&s, thing_box(2, 10, 0.1), pose_of(2, 0, 0.05), 1);
  stage_add(&s, thing_box(10, 10, 1), pose_of(0, 0, 1.05), 1);
  const size_t id = add_cube(&s, 0, 0, 0.2512);
  actor a = character_of(&s, id, 0.2f);
  for (int f = 0; f < 120; f++) frame(&a, 1, 0);
  keeps_clear(&a);
  CHECK_NEAR(place(&a, 0), 0.75 - REST, 1e-3);
  CHECK_NEAR(place(&a, 2), 0.25 + REST, 1e-3);
  stage_end(&s);
}

// A character of 1.2 m with round feet of 30 cm, whose origin is at its sole, by its facets.
static thing thing_pill(void) {
  enum { ROWS = 18 };
  double profile[2 * ROWS + 2][2];
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  for (int k = 0; k <= ROWS; k++) {
    const double angle = 1.570796326794897 * k / ROWS;
    const double across = k ? 0.3 * sin(angle) : 0;
    profile[k][0] = profile[2 * ROWS + 1 - k][0] = across;
    profile[k][1] = 0.3 - 0.3 * cos(angle);
    profile[2 * ROWS + 1 - k][1] = 0.9 + 0.3 * cos(angle);
  }
  shapes_lathe(&shape, profile, 2 * ROWS + 2, 36, 0);
  return thing_of(&shape);
}
// Walks and runs on round feet over kerbs up to its step of 25 cm and back, at its pace, and is never
// thrown up. Not onto one of 28 cm, which its feet could roll over, nor up a riser of 10 cm with a
// ramp of 40 degrees behind it, which is too steep, though a step farther on there is room.
static void round_feet_climb_kerbs(void) {
  static const double heights[5] = {0.1, 0.2, 0.245, 0.28, 0.1};
  for (int run = 0; run < 10; run++) {
    const int is_ramp = run / 2 == 4;
    const int is_climbed = run / 2 < 3;
    const float speed = run % 2 ? 4 : 1;
    const int frames = run % 2 ? 30 : 120;
    const double high = heights[run / 2];
    const double at = 1 - sqrt(0.09 - (0.3 - high) * (0.3 - high));
    const double by = 0.6981317008;
    stage s = stage_begin();
    add_floor(&s);
    const nsvcd_pose ramp =
        turned(1 + 3 * cos(by) + 0.5 * sin(by), 0, high + 3 * sin(by) - 0.5 * cos(by), 1, -by);
    const nsvcd_pose kerb = pose_of(2, 0, 0.5 * high);
    stage_add(&s, is_ramp ? thing_box(6, 8, 1) : thing_box(2, 8, high), is_ramp ? ramp : kerb, 1);
    const size_t id = stage_add(&s, thing_pill(), pose_of(0, 0, 0.002), 0);
    actor a = character_of(&s, id, is_ramp ? 0.5f : 0.25f);
    if (is_ramp) a.options.slope = 0.8f;
    int stops = 0;
    for (int f = 0; f < 2 * frames; f++) {
      const double before = place(&a, 0);
      frame(&a, f < frames ? speed : -speed, 0);
      CHECK_LE(fabs(place(&a, 0) - before), (double)(speed * FRAME) + 1e-3);
      CHECK_LE(place(&a, 2), (is_climbed ? high : 0) + 0.004);
      CHECK_LE(a.velocity.linear[2], 1e-6f);
      stops += is_climbed && fabs((double)a.velocity.linear[0]) < 0.9 * (double)speed;
      if (f + 1 != frames) continue;
      CHECK_NEAR(place(&a, 0), is_climbed ? 2 : at, 0.01);
      CHECK_NEAR(place(&a, 2), (is_climbed ? high : 0) + REST, 1e-3);
    }
    CHECK_NEAR(place(&a, 0), is_climbed ? 0 : at - 2, 0.02);
    CHECK_NEAR(place(&a, 2), REST, 1e-3);
    keeps_clear(&a);
    CHECK_LE(stops, 1);
    // it jumps, walking into the kerb
    const nsvcd_pose before_kerb = pose_of(at - 0.002, 0, REST);
    CHECK_EQ(nsvcd_world_move(s.world, id, &before_kerb), NSVCD_OK);
    a.velocity.linear[2] = 3;
    for (int f = 0; f < 18; f++) frame(&a, 1, 0);
    CHECK_NEAR(place(&a, 2), 0.45, 0.03);
    stage_end(&s);
  }
}

// A capsule of 1.8 m, 30 cm around an axis, which a needle is for the oracle.
#define AROUND 0.3
static thing thing_capsule(void) {
  const float low[3] = {0, 0, -0.6f};
  const float high[3] = {0, 0, 0.6f};
  thing out = thing_box(1e-5, 1e-5, 1.2);
  nsvcd_body_free(out.body, NULL);
  CHECK_EQ(nsvcd_encode_capsule(low, high, (float)AROUND, NULL, &out.body), NSVCD_OK);
  return out;
}
// Four stairs along x from 0 on, of one body or of four, and a landing as high as they.
static void add_stairs(stage *s, double rise, double run, int is_one) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  for (int k = 1; k <= 4; k++) {
    const double deep = k < 4 ? run : 3;
    const double x = run * (k - 1) + 0.5 * deep;
    if (is_one) shapes_box_at(&shape, x, 0, 0.5 * rise * k, deep, 2, rise * k);
    if (!is_one) stage_add(s, thing_box(deep, 2, rise * k), pose_of(x, 0, 0.5 * rise * k), 1);
  }
  if (is_one) stage_add(s, thing_of(&shape), pose_of(0, 0, 0), 1);
}
// Walks towards +x for so many metres, and a tenth more.
static actor walks_to_stairs(stage *s, double step, float speed, double metres) {
  const size_t id = stage_add(s, thing_capsule(), pose_of(-0.6, 0, 0.906), 0);
  actor a = character_of(s, id, (float)step);
  a.options.clearance = a.options.margin = 0;
  const int frames = (int)(1.1 * metres * 60 / (double)speed);
  for (int f = 0; f < frames; f++) {
    a.velocity.linear[0] = speed;
    a.velocity.linear[2] -= gravity;
    slide(&a);
    if (f % 8 == 7) CHECK_GE(stage_apart(s, id), AROUND + 0.0045 - 1e-4);
  }
  return a;
}
// However much higher than its stairs the step is, and wherever the next stair meets the capsule first.
static void climbs_stairs_by_any_step(void) {
  static const double runs[5] = {0.2, 0.25, 0.3, 0.4, 0.6};
  for (int n = 0; n < 90; n++) {
    const double rise = 0.1 * (1 + n % 3);
    const double run = runs[n / 3 % 5];
    const double step = rise + 0.02 + (2 * rise - 0.02) * (n % 7) / 6;
    const float speed = (float)(1 << n / 15 % 3);
    stage s = stage_begin();
    add_floor(&s);
    add_stairs(&s, rise, run, n / 45);
    const actor a = walks_to_stairs(&s, step, speed, 3 * run + 1);
    CHECK_GE(place(&a, 0), 3 * run + 0.3);
    CHECK_NEAR(place(&a, 2), 4 * rise + 0.9 + 0.008, 0.004);
    stage_end(&s);
  }
}
// A kerb lower than 9 cm is a ground to its feet.
static void stops_at_what_is_higher_than_its_step(void) {
  static const double steps[4] = {0.1, 0.2, 0.3, 0.6};
  for (int n = 0; n < 16; n++) {
    stage s = stage_begin();
    const double high = steps[n % 4] + 0.02;
    add_floor(&s);
    stage_add(&s, thing_box(2, 2, high), pose_of(1, 0, 0.5 * high), 1);
    const actor a = walks_to_stairs(&s, steps[n % 4], (float)(1 << n / 4), 1.5);
    CHECK_LE(place(&a, 0), -0.2);
    CHECK_LE(place(&a, 2), 0.95);
    stage_end(&s);
  }
}

// Walks down them on ground in every frame; down what is higher than a step, by 2 cm, it falls.
static void goes_down_stairs_on_ground(void) {
  static const double runs[5] = {0.2, 0.25, 0.3, 0.4, 0.6};
  for (int n = 0; n < 90; n++) {
    const int falls = n >= 45;
    const double rise = 0.1 * (1 + n % 3);
    const double run = runs[n / 3 % 5];
    const float speed = (float)(1 << n / 15 % 3);
    if (falls && rise < 0.15) continue;  // its feet roll over edges of up to 9 cm
    stage s = stage_begin();
    add_floor(&s);
    add_stairs(&s, rise, run, n % 2);
    const size_t id =
        stage_add(&s, thing_capsule(), pose_of(3 * run + 0.6, 0, 4 * rise + 0.906), 0);
    actor a = character_of(&s, id, (float)(rise + (falls ? -0.02 : 0.02)));
    a.options.clearance = a.options.margin = 0;
    int in_air = 0;
    double falling = 0;
    for (int f = 0; f < (int)((3 * run + 1.2) * 60 / (double)speed); f++) {
      a.velocity.linear[0] = -speed;
      a.velocity.linear[2] -= gravity;
      slide(&a);
      in_air += a.answer.ground == NSVCD_NOBODY;
      falling = fmin(falling, (double)a.velocity.linear[2]);
      if (f % 8 == 7) CHECK_GE(stage_apart(&s, id), AROUND + 0.0045 - 1e-4);
    }
    if (falls) CHECK_GE(in_air, 10);
    if (falls) CHECK_LE(falling, -1.4);
    if (!falls) CHECK_EQ(in_air, 0);
    if (!falls) CHECK_NEAR(place(&a, 2), 0.9 + 0.008, 0.004);
    CHECK_LE(place(&a, 0), -0.5);
    stage_end(&s);
  }
}

// Whoever stops on an edge on the way down does not hang there; and who jumps from there jumps.
static void edges_hold_nobody(void) {
  int were_on_edge = 0;
  for (int n = 0; n < 24; n++) {
    const int jumps = n % 2;
    stage s = stage_begin();
    add_floor(&s);
    add_stairs(&s, 0.2, 0.3, 0);
    const size_t id = stage_add(&s, thing_capsule(), pose_of(1.1, 0, 0.8 + 0.901), 0);
    actor a = character_of(&s, id, 0.25f);
    for (int f = 0; f < 12 + n / 2; f++) frame(&a, -2, 0);
    const double high = place(&a, 2);
    were_on_edge += a.answer.ground_normal[2] < 0.7f;
    CHECK(a.answer.ground != NSVCD_NOBODY);
    a.velocity.linear[2] = jumps ? 3 : 0;
    for (int f = 0; f < (jumps ? 18 : 60); f++) frame(&a, jumps ? -2 : 0, 0);
    if (jumps) CHECK_NEAR(place(&a, 2) - high, 0.45, 0.03);
    if (!jumps) CHECK_GE(a.answer.ground_normal[2], 0.7f);
    stage_end(&s);
  }
  CHECK_GE(were_on_edge, 3);
}

static void walks_on_an_elevator(void) {
  stage s = stage_begin();
  const size_t lift = add_floor(&s);
  const size_t id = add_cube(&s, 0, 0, 0.2512);
  actor a = character_of(&s, id, 0.1f);
  for (int f = 0; f < 120; f++) {
    nsvcd_pose to = stage_pose(&s, lift);
    to.position[2] += 1.0f * FRAME;
    CHECK_EQ(nsvcd_world_drive(s.world, lift, &to), NSVCD_OK);
    frame(&a, 1, 0);
  }
  keeps_clear(&a);
  CHECK_NEAR(place(&a, 0), 2, 2e-3);
  CHECK_NEAR(place(&a, 2), 2.25 + REST, 2e-3);
  stage_end(&s);
}

// On a train that goes forward, back up a step: as fast as on the ground.
static void climbs_on_a_train(void) {
  for (int back = 0; back < 2; back++) {
    stage s = stage_begin();
    const double side = back ? -1 : 1;
    const size_t train[2] = {add_floor(&s),
                             stage_add(&s, thing_box(2, 10, 0.1), pose_of(2 * side, 0, 0.0501), 1)};
    const size_t id = add_cube(&s, 0, 0, 0.2512);
    actor a = character_of(&s, id, 0.2f);
    for (int f = 0; f < 120; f++) {
      for (int k = 0; k < 2; k++) {
        nsvcd_pose to = stage_pose(&s, train[k]);
        to.position[0] += 2 * FRAME;
        CHECK_EQ(nsvcd_world_drive(s.world, train[k], &to), NSVCD_OK);
      }
      frame(&a, (float)side, 0);
    }
    keeps_clear(&a);
    CHECK_NEAR(place(&a, 0), 4 + 2 * side, 5e-3);
    CHECK_NEAR(place(&a, 2), 0.35 + REST, 1e-3);
    stage_end(&s);
  }
}

static void between_two_movers(void) {
  stage s = stage_begin();
  add_floor(&s);
  actor a[3];
  for (int k = 0; k < 3; k++) {
    const size_t id = add_cube(&s, 0, 0.8 * (k - 1), 0.2512);
    a[k] = k == 1 ? character_of(&s, id, 0.1f) : prop_of(&s, id, 0);
    // edges along faces at just the clearance: without a limit some questions take a million units
  }
  for (int f = 0; f < 120; f++) {
    frame(&a[0], 0, 1);
    frame(&a[2], 0, -1);
    frame(&a[1], 1, 0);
  }
  for (int k = 0; k < 3; k++) keeps_clear(&a[k]);
  CHECK_NEAR(place(&a[1], 0), 2, 5e-3);
  stage_end(&s);
}

// ---- many

// Props, characters and driven bodies in a pit, with kicks: what was clear of all before a frame is clear
// after it, or told as caught.
enum { ACTORS = 8, DRIVERS = 3 };
typedef struct pit {
  stage s;
  actor actors[ACTORS];
  size_t drivers[DRIVERS];
  nsvcd_pose begins[DRIVERS];
  double x;
} pit;

static pit *pit_begin(uint64_t seed, double x) {
  pit *out = (pit *)calloc(1, sizeof *out);
  if (!out) exit(1);
  rng_state = seed;
  out->s = stage_begin();
  out->x = x;
  stage *s = &out->s;
  stage_add(s, thing_box(6, 6, 1), pose_of(x, 0, -0.5), 1);
  stage_add(s, thing_box(0.3, 4, 2), pose_of(x + 1.6, 0, 1.01), 1);
  stage_add(s, thing_box(0.3, 4, 2), pose_of(x - 1.6, 0, 1.01), 1);
  stage_add(s, thing_box(4, 0.3, 2), pose_of(x, 1.6, 1.01), 1);
  stage_add(s, thing_box(4, 0.3, 2), pose_of(x, -1.6, 1.01), 1);
  static const double sizes[DRIVERS][3] = {{0.3, 0.3, 0.5}, {0.8, 0.1, 0.3}, {0.8, 0.8, 0.06}};
  for (int k = 0; k < DRIVERS; k++) {
    const double high = k == 0 ? 0.3 : k == 1 ? 1 : 0.05;
    out->begins[k] = pose_of(x + uniform(-1, 1), uniform(-1, 1), high);
    const thing t = thing_box(sizes[k][0], sizes[k][1], sizes[k][2]);
    out->drivers[k] = stage_add(s, t, out->begins[k], 0);
  }
  for (int k = 0; k < ACTORS; k++) {
    nsvcd_world_body body;
    memset(&body, 0, sizeof body);
    const int walks = k == 0 || k == ACTORS - 1;
    body.pose = pose_of(x + uniform(-1, 1), uniform(-1, 1), 1.5 + 0.5 * k);
    if (!walks) random_quat(body.pose.rotation);
    for (int i = 0; i < 3 && k % 2; i++) body.pivot[i] = (float)uniform(-0.05, 0.05);
    const thing t = thing_box(uniform(0.1, 0.4), uniform(0.1, 0.4), uniform(0.1, 0.4));
    const size_t id = stage_add_body(s, t, body);
    actor *a = &out->actors[k];
    *a = walks ? character_of(s, id, 0.1f) : prop_of(s, id, k % 3 ? 0.5f : 0.05f);
    for (int i = 0; i < 3; i++) a->options.inertia[i] *= k == 4 ? 0 : 0.1f;
    a->options.restitution = k % 2 ? 0.3f : 0;
  }
  return out;
}
static void pit_drives(const pit *p, double t) {
  for (int k = 0; k < DRIVERS; k++) {
    nsvcd_pose to = p->begins[k];
    if (k == 1) to = turned((double)to.position[0], (double)to.position[1], 0, 2, t);
    if (k == 0) to.position[0] += (float)(0.6 * sin(t));
    if (k == 0) to.position[1] += (float)(0.4 * sin(1.7 * t));
    if (k == 1) to.position[2] = (float)(1 - 0.6 * sin(0.7 * t));
    if (k == 2) to.position[2] += (float)(0.4 * (1 - cos(t)));
    CHECK_EQ(nsvcd_world_drive(p->s.world, p->drivers[k], &to), NSVCD_OK);
  }
}
static void pit_frame(pit *p, int f, double pace) {
  const double clear = (double)NEAR - 1e-5 - 2e-7 * p->x;
  double before[ACTORS];
  pit_drives(p, (f + 1) * pace / 60);
  for (int k = 0; k < ACTORS; k++) before[k] = stage_apart(&p->s, p->actors[k].id);
  for (int k = 0; k < ACTORS; k++) {
    actor *a = &p->actors[k];
    a->velocity.linear[2] -= gravity;
    if (a->options.up[2] > 0) a->velocity.linear[0] = (float)cos(f * 0.02 + k);
    if (a->options.up[2] > 0) a->velocity.linear[1] = (float)sin(f * 0.03 + k);
    if (f % 40 == 39) a->velocity.linear[f % 3] += (float)uniform(-30, 30);
    if (f % 40 == 20) a->velocity.angular[f % 3] += (float)uniform(-60, 60);
    const nsvcd_pose was = stage_pose(&p->s, a->id);
    slide(a);
    const nsvcd_pose now = stage_pose(&p->s, a->id);
    CHECK(!memcmp(&now, &a->answer.pose, sizeof now));
    if (a->answer.rests) CHECK(!memcmp(&now, &was, sizeof now));
  }
  CHECK_EQ(nsvcd_world_arrive(p->s.world), NSVCD_OK);
  for (int k = 0; k < ACTORS; k++) {
    if (before[k] < clear || p->actors[k].answer.caught) continue;
    CHECK_GE(stage_apart(&p->s, p->actors[k].id), clear);
  }
}
static void pit_end(pit *p) {
  stage_end(&p->s);
  free(p);
}

static void nothing_overlaps_in_a_pit(void) {
  const size_t pits = check_many(3);
  for (size_t n = 0; n < pits; n++) {
    pit *p = pit_begin(n + 1, n % 3 == 2 ? 1000 : 0);
    int caught = 0;
    for (int f = 0; f < 100; f++) {
      pit_frame(p, f, 0.5 + (double)(n % 4));
      for (int k = 0; k < ACTORS; k++) caught += p->actors[k].answer.caught != NSVCD_NOBODY;
    }
    CHECK_LE(caught, 50);
    for (int k = 0; k < ACTORS; k++) CHECK_GE(place(&p->actors[k], 2), 0);
    pit_end(p);
  }
}

// The same calls, the same bits, in whatever memory.
static void the_same_frames_to_the_bit(void) {
  pit *a = pit_begin(3, 0);
  pit *b = pit_begin(3, 0);
  for (int f = 0; f < 60; f++) {
    const uint64_t kicks = rng_state;
    pit_frame(a, f, 1);
    rng_state = kicks;
    pit_frame(b, f, 1);
    for (int k = 0; k < ACTORS; k++) {
      CHECK(!memcmp(&a->actors[k].answer.pose, &b->actors[k].answer.pose, sizeof(nsvcd_pose)));
      CHECK(!memcmp(&a->actors[k].velocity, &b->actors[k].velocity, sizeof(nsvcd_velocity)));
      CHECK_EQ(a->actors[k].answer.work, b->actors[k].answer.work);
    }
  }
  pit_end(a);
  pit_end(b);
}

// A kilometre from the origin, where floats are 0.06 mm apart; and by defaults.
static void far_from_the_origin_and_by_defaults(void) {
  for (int by_default = 0; by_default < 2; by_default++) {
    stage s = stage_begin();
    const double x = by_default ? 0 : 1000;
    stage_add(&s, thing_box(10, 10, 1), pose_of(x, x, -0.5), 1);
    stage_add(&s, thing_box(0.3, 6, 2), pose_of(x + 0.405, x, 1.01), 1);
    const size_t id = add_cube(&s, x, x, 0.26);
    actor a = prop_of(&s, id, 0);
    const float clearance = 0.005f * 0.4330127f;
    if (by_default) memset(&a.options, 0, sizeof a.options);
    for (int f = 0; f < 300; f++) frame(&a, 1, 0.5f);
    CHECK_EQ(a.overlaps, 0);
    CHECK_GE(a.least, by_default ? (double)clearance - 1e-5 : (double)NEAR - 1e-4);
    CHECK_NEAR(place(&a, 1), x + 2.5, by_default ? 1e-3 : 0.02);
    stage_end(&s);
  }
}

// ---- bad input

static void bad_slides_are_refused(void) {
  stage s = stage_begin();
  add_floor(&s);
  const size_t id = add_cube(&s, 0, 0, 0.2512);
  const actor good = prop_of(&s, id, 0.5f);
  nsvcd_velocity velocity = {{0, 0, -1}, {0, 0, 0}};
  const nsvcd_velocity same = velocity;
  nsvcd_slide_answer answer, before;
  size_t size;
  void *memory = workspace(&size);
  memset(&answer, 0, sizeof answer);
  memset(&before, 0, sizeof before);
  const nsvcd_pose there = stage_pose(&s, id);
#define REFUSED(change, code)                                                                \
  do {                                                                                       \
    nsvcd_slide_options o = good.options;                                                    \
    nsvcd_velocity v = velocity;                                                             \
    float seconds = FRAME;                                                                   \
    size_t who = id;                                                                         \
    change;                                                                                  \
    const nsvcd_velocity given = v;                                                          \
    CHECK_EQ(nsvcd_world_slide(s.world, who, &o, seconds, memory, size, &v, &answer), code); \
    CHECK(!memcmp(&v, &given, sizeof v));                                                    \
    CHECK(!memcmp(&answer, &before, sizeof answer));                                         \
    const nsvcd_pose now = stage_pose(&s, id);                                               \
    CHECK(!memcmp(&now, &there, sizeof now));                                                \
    (void)seconds;                                                                           \
  } while (0)
  REFUSED(who = 0, NSVCD_ERROR_INDEX);
  REFUSED(who = 3, NSVCD_ERROR_INDEX);
  REFUSED(seconds = 0, NSVCD_ERROR_TIMES);
  REFUSED(seconds = -1, NSVCD_ERROR_TIMES);
  REFUSED(seconds = NAN, NSVCD_ERROR_TIMES);
  REFUSED(v.linear[0] = NAN, NSVCD_ERROR_SPEED);
  REFUSED(v.angular[2] = 2e6f, NSVCD_ERROR_SPEED);
  REFUSED(o.clearance = -1, NSVCD_ERROR_CLEARANCE);
  REFUSED(o.margin = NAN, NSVCD_ERROR_CLEARANCE);
  REFUSED(o.mass = -1, NSVCD_ERROR_VALUE);
  REFUSED(o.inertia[1] = NAN, NSVCD_ERROR_VALUE);
  REFUSED(o.friction = -1, NSVCD_ERROR_VALUE);
  REFUSED(o.restitution = 1.5f, NSVCD_ERROR_VALUE);
  REFUSED(o.slope = 2, NSVCD_ERROR_VALUE);
  REFUSED(o.up[1] = 2, NSVCD_ERROR_AXIS);
  REFUSED(o.up[1] = NAN, NSVCD_ERROR_AXIS);
  REFUSED(o.step = -1, NSVCD_ERROR_DISTANCE);
  const nsvcd_slide_options *o = &good.options;
  CHECK_EQ(nsvcd_world_slide(NULL, id, o, FRAME, memory, size, &velocity, &answer),
           NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_slide(s.world, id, o, FRAME, memory, size, NULL, &answer),
           NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_slide(s.world, id, o, FRAME, memory, size, &velocity, NULL),
           NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_world_slide(s.world, id, o, FRAME, NULL, size, &velocity, &answer),
           NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_world_slide(s.world, id, o, FRAME, memory, 64, &velocity, &answer),
           NSVCD_ERROR_WORKSPACE);
  CHECK(!memcmp(&velocity, &same, sizeof same));
  // so far that no pose is there: the code of a pose, and nothing has happened
  velocity.linear[0] = 1e6f;
  CHECK_EQ(nsvcd_world_slide(s.world, id, o, 1000, memory, size, &velocity, &answer),
           NSVCD_ERROR_POSE);
  CHECK_EQ(velocity.linear[0], 1e6f);
  CHECK(!memcmp(&answer, &before, sizeof answer));
  const nsvcd_pose now = stage_pose(&s, id);
  CHECK(!memcmp(&now, &there, sizeof now));
  stage_end(&s);
}

void test_slide(void) {
  RUN(on_a_floor_at_full_speed);
  RUN(along_a_wall_at_full_speed);
  RUN(along_a_slot_at_full_speed);
  RUN(below_a_ceiling_at_full_speed);
  RUN(along_walls_of_one_body);
  RUN(into_a_corner_and_stays);
  RUN(what_is_dropped_comes_to_rest);
  RUN(what_rested_rests_again);
  RUN(friction_on_a_slope);
  RUN(what_falls_bounces);
  RUN(a_stack_of_ten_stands);
  RUN(rides_elevators);
  RUN(what_touches_at_first_gets_away);
  RUN(is_caught_below_a_ceiling);
  RUN(rides_turntables);
  RUN(a_door_pushes);
  RUN(climbs_steps_and_goes_down);
  RUN(walks_on_slopes);
  RUN(does_not_rise_along_a_steep_slope);
  RUN(does_not_step_below_a_low_ceiling);
  RUN(round_feet_climb_kerbs);
  RUN(climbs_stairs_by_any_step);
  RUN(stops_at_what_is_higher_than_its_step);
  RUN(goes_down_stairs_on_ground);
  RUN(edges_hold_nobody);
  RUN(walks_on_an_elevator);
  RUN(climbs_on_a_train);
  RUN(between_two_movers);
  RUN(nothing_overlaps_in_a_pit);
  RUN(the_same_frames_to_the_bit);
  RUN(far_from_the_origin_and_by_defaults);
  RUN(bad_slides_are_refused);
}

CHECK_ALONE(test_slide)
