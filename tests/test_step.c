// Frames of all movers of a world: does nothing overlap, do piles stand and sleep, is momentum kept
// and no energy gained, does what sleeps wake? Against distances in double by the oracle, and sums on
// paper.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "../extras/neuralsvcd_world.h"

#include "world_scene.h"

void test_step(void);

#define FRAME (1.0f / 60)
#define NEAR 0.0005f  // the clearance and the margin
static const nsvcd_step_options earth = {{0, 0, -9.81f}, 0, 0};
static const nsvcd_step_options space = {{0, 0, 0}, 0, 0};

static size_t add_floor(stage *s) {
  return stage_add(s, thing_box(20, 20, 1), pose_of(0, 0, -0.5), 1);
}
// A cube of half a metre, that turns or not.
static nsvcd_world_mover add_cube(stage *s, double x, double y, double z, float mass, int turns) {
  nsvcd_world_mover out;
  memset(&out, 0, sizeof out);
  out.id = stage_add(s, thing_box(0.5, 0.5, 0.5), pose_of(x, y, z), 0);
  out.how.clearance = out.how.margin = NEAR;
  out.how.mass = mass;
  out.how.friction = turns ? 0.5f : 0;
  for (int k = 0; k < 3 && turns; k++) out.how.inertia[k] = mass / 24;
  return out;
}
static thing thing_ball(float radius) {
  thing out;
  memset(&out, 0, sizeof out);
  CHECK_EQ(nsvcd_encode_sphere(radius, NULL, &out.body), NSVCD_OK);
  return out;
}
static nsvcd_step_answer step(stage *s, nsvcd_world_mover *movers, size_t count,
                              const nsvcd_step_options *options) {
  size_t size;
  nsvcd_step_answer out;
  void *memory = workspace(&size);
  memset(&out, 0x5a, sizeof out);
  CHECK_EQ(nsvcd_world_step(s->world, movers, count, options, FRAME, memory, size, &out), NSVCD_OK);
  CHECK_EQ(out.refused, NSVCD_NOBODY);
  return out;
}
static void keep_apart(const stage *s, const nsvcd_world_mover *movers, size_t count) {
  for (size_t k = 0; k < count; k++)
    CHECK_GE(stage_apart(s, movers[k].id), (double)movers[k].how.clearance - 1e-5);
}

// ---- rest

// In an order that is no good, and with what was added last below.
static void seven_stacks_of_five_stand(void) {
  enum { STACKS = 7, TALL = 5, ALL = STACKS * TALL };
  stage s = stage_begin();
  nsvcd_world_mover movers[ALL];
  nsvcd_pose begins[ALL];
  nsvcd_step_answer answer;
  add_floor(&s);
  for (int k = 0; k < ALL; k++) {
    const int level = (k * 3) % TALL;
    movers[k] = add_cube(&s, k / TALL - 3, 0.02 * (level % 2), 0.26 + 0.502 * level, 1, 1);
  }
  for (int f = 0; f < 90; f++) {
    answer = step(&s, movers, ALL, &earth);
    if (f % 30 == 29) keep_apart(&s, movers, ALL);
    for (int k = 0; k < ALL && f == 10; k++) begins[k] = stage_pose(&s, movers[k].id);
  }
  CHECK_EQ(answer.asleep, ALL);
  CHECK_EQ(answer.awake, 0);
  CHECK_EQ(answer.questions, 0);
  for (int k = 0; k < ALL; k++) {
    const nsvcd_pose now = stage_pose(&s, movers[k].id);
    for (int i = 0; i < 3; i++) CHECK_NEAR(now.position[i], begins[k].position[i], 10 * NEAR);
    CHECK_EQ(movers[k].asleep, 1);
  }
  stage_end(&s);
}

// Crates that fell upon each other, in stacks that stand askew, with the clearance of the defaults.
static void stacks_fall_asleep(void) {
  enum { TALL = 5 };
  for (int n = 0; n < 80; n++) {
    stage s = stage_begin();
    nsvcd_world_mover m[TALL];
    add_floor(&s);
    for (int k = 0; k < TALL; k++) {
      m[k] = add_cube(&s, (0.025 + 0.0017 * (n % 40)) * k, 0, 0.75 + (0.62 + 0.0075 * (n % 40)) * k,
                      n < 40 ? 2 : 2 + k, 1);
      m[k].how.clearance = m[k].how.margin = 0;
    }
    size_t asleep = 0;
    for (int f = 0; f < 180 && asleep < TALL; f++) asleep = step(&s, m, TALL, &earth).asleep;
    CHECK_EQ(asleep, TALL);
    stage_end(&s);
  }
}

// Boxes and balls, turned in any way, that fall into a shaft.
static void heaps_fall_asleep(void) {
  enum { TALL = 10 };
  for (int n = 0; n < 14; n++) {
    rng_state = 1714 + (uint64_t)n;  // three of them lie awake where who creeps does not stand
    stage s = stage_begin();
    nsvcd_world_mover m[TALL];
    add_floor(&s);
    for (int side = -1; side <= 1; side += 2) {
      stage_add(&s, thing_box(10, 10, 20), pose_of(5.8 * side, 0, 9), 1);
      stage_add(&s, thing_box(10, 10, 20), pose_of(0, 5.8 * side, 9), 1);
    }
    for (int k = 0; k < TALL; k++) {
      memset(&m[k], 0, sizeof m[k]);
      nsvcd_pose pose = pose_of(0, 0, 0.5 + k);
      for (int j = 0; j < 2; j++) pose.position[j] = (float)uniform(-0.25, 0.25);
      random_quat(pose.rotation);
      m[k].id = stage_add(&s, k % 3 ? thing_box(0.5, 0.4, 0.3) : thing_ball(0.25f), pose, 0);
      m[k].how.mass = (float)(1 + k % 3);
      m[k].how.friction = 0.5f;
      for (int j = 0; j < 3; j++) m[k].how.inertia[j] = 0.03f * m[k].how.mass;
    }
    size_t asleep = 0;
    for (int f = 0; f < 900 && asleep < TALL; f++) asleep = step(&s, m, TALL, &earth).asleep;
    CHECK_EQ(asleep, TALL);
    stage_end(&s);
  }
}

// Movers of a level that was left, in the next one: its floor is lower.
static void a_new_world_begins_afresh(void) {
  for (int sleepless = 0; sleepless < 2; sleepless++) {
    nsvcd_world_mover m = {0};
    for (int level = 0; level < 2; level++) {
      stage s = stage_begin();
      stage_add(&s, thing_box(20, 20, 1), pose_of(0, 0, -0.5 - 2 * level), 1);
      const nsvcd_world_mover fresh = add_cube(&s, 0, 0, 0.2512, 1, 1);
      if (level == 0) m = fresh;
      if (level == 1) CHECK_EQ(nsvcd_world_move(s.world, m.id, &m.answer.pose), NSVCD_OK);
      m.sleepless = sleepless;
      CHECK_EQ(m.id, fresh.id);
      for (int f = 0; f < 90; f++) step(&s, &m, 1, &earth);
      CHECK_NEAR(m.answer.pose.position[2], 0.25 - 2 * level, 2 * (double)NEAR + 1e-5);
      CHECK_EQ(m.asleep, !sleepless);
      stage_end(&s);
    }
  }
}

// The bytes of the world and its movers, put back: the same frames follow, to the bit.
static void what_is_saved_goes_on_as_it_did(void) {
  enum { CUBES = 5 };
  stage s = stage_begin();
  nsvcd_world_mover m[CUBES], saved[CUBES];
  nsvcd_pose after[2][CUBES];
  const size_t size = nsvcd_world_size(STAGE_MOST);
  void *copy = malloc(size);
  if (!copy) exit(1);
  add_floor(&s);
  for (int k = 0; k < CUBES; k++) m[k] = add_cube(&s, 0.03 * k, 0.05 * k, 1 + 0.6 * k, 1, 1);
  for (int f = 0; f < 10; f++) step(&s, m, CUBES, &earth);
  memcpy(copy, s.memory, size);
  memcpy(saved, m, sizeof m);
  for (int again = 0; again < 2; again++) {
    for (int f = 0; f < 60; f++) step(&s, m, CUBES, &earth);
    for (int k = 0; k < CUBES; k++) after[again][k] = stage_pose(&s, m[k].id);
    memcpy(s.memory, copy, size);
    memcpy(m, saved, sizeof m);
  }
  CHECK(!memcmp(after[0], after[1], sizeof after[0]));
  for (int k = 0; k < CUBES; k++) {
    const nsvcd_pose at = stage_pose(&s, m[k].id);
    CHECK(memcmp(&at, &after[0][k], sizeof at));  // they had moved
  }
  free(copy);
  stage_end(&s);
}

// Of whoever has not slid too: that sleeps from the start, or is driven.
static void an_answer_tells_where_it_is(void) {
  stage s = stage_begin();
  nsvcd_world_mover m[2];
  const nsvcd_pose to = pose_of(3, 0, 2);
  m[0] = add_cube(&s, 1, 2, 3, 1, 1);
  m[0].asleep = 1;
  m[1] = add_cube(&s, 3, 0, 1, 1, 1);
  CHECK_EQ(nsvcd_world_drive(s.world, m[1].id, &to), NSVCD_OK);
  step(&s, m, 2, &earth);
  for (int k = 0; k < 2; k++) {
    const nsvcd_pose at = stage_pose(&s, m[k].id);
    CHECK(!memcmp(&m[k].answer.pose, &at, sizeof at));
  }
  CHECK_EQ(m[0].answer.pose.position[2], 3);
  CHECK_EQ(m[1].answer.pose.position[2], 2);
  stage_end(&s);
}

// ---- on what moves

// How a platform goes: starts, goes, and stops.
typedef struct ride {
  double accelerates, fast;  // metres or radians a second, and a second more
  int frames;                // at that speed
  int axis;                  // 0 to 2: along it; 3: about z
  int stacks, tall;          // on it
  double friction, within;   // metres: how far from its place a box may come
} ride;

static nsvcd_pose ride_pose(const ride *r, double at) {
  if (r->axis == 3) return turned(0, 0, -0.1, 2, at);
  return pose_of(r->axis == 0 ? at : 0, r->axis == 1 ? at : 0, (r->axis == 2 ? at : 0) - 0.1);
}
// Where a place on the platform is.
static void ride_carries(const ride *r, double at, const double place[3], double out[3]) {
  const double c = r->axis == 3 ? cos(at) : 1;
  const double s = r->axis == 3 ? sin(at) : 0;
  out[0] = c * place[0] - s * place[1] + (r->axis == 0 ? at : 0);
  out[1] = s * place[0] + c * place[1] + (r->axis == 1 ? at : 0);
  out[2] = place[2] + (r->axis == 2 ? at : 0);
}
// Returns the most that a box has come off its place while it rode.
static double take_a_ride(const ride *r, double ceiling) {
  enum { MOST = 20 };
  stage s = stage_begin();
  nsvcd_world_mover m[MOST];
  double places[MOST][3];
  double off = 0, at = 0, speed = 0;
  const int all = r->stacks * r->tall;
  const int ramp = (int)(60 * fabs(r->fast) / r->accelerates + 0.5);
  const size_t lift = stage_add(&s, thing_box(4, 4, 0.2), pose_of(0, 0, -0.1), 0);
  nsvcd_step_answer answer;
  if (ceiling > 0) stage_add(&s, thing_box(9, 9, 1), pose_of(0, 0, ceiling + 0.5), 1);
  for (int k = 0; k < all; k++) {
    m[k] = add_cube(&s, 0.502 * (k / r->tall), 0.9 + 0.02 * (k % 2),
                    0.2515 + 0.5015 * (k % r->tall), 1, 1);
    m[k].how.friction = (float)r->friction;
  }
  for (int f = 0; f < 60; f++) answer = step(&s, m, (size_t)all, &earth);
  CHECK_EQ(answer.asleep, all);
  for (int k = 0; k < all; k++)
    for (int i = 0; i < 3; i++) places[k][i] = (double)stage_pose(&s, m[k].id).position[i];
  for (int f = 0; f < r->frames + 2 * ramp; f++) {
    const double share =
        ramp > 0 ? fmin(1, fmin(f + 1, r->frames + 2 * ramp - f) / (double)ramp) : 1;
    speed = r->fast * share;
    at += speed / 60;
    const nsvcd_pose to = ride_pose(r, at);
    CHECK_EQ(nsvcd_world_drive(s.world, lift, &to), NSVCD_OK);
    CHECK_EQ(step(&s, m, (size_t)all, &earth).caught, 0);
    keep_apart(&s, m, (size_t)all);
    for (int k = 0; k < all; k++) {
      const nsvcd_pose now = stage_pose(&s, m[k].id);
      double there[3];
      ride_carries(r, at, places[k], there);
      for (int i = 0; i < 3; i++) off = fmax(off, fabs((double)now.position[i] - there[i]));
    }
  }
  for (int f = 0; f < 60; f++) answer = step(&s, m, (size_t)all, &earth);
  keep_apart(&s, m, (size_t)all);
  CHECK_EQ(answer.asleep, all);
  stage_end(&s);
  return off;
}

static void stacks_ride(void) {
  static const ride rides[] = {
      {3, 1, 40, 2, 1, 1, 0.5, 0},     {3, 2, 40, 2, 1, 4, 0.5, 0},
      {3, -1, 40, 2, 1, 1, 0.5, 0},    {3, -2, 40, 2, 1, 2, 0.5, 0},
      {3, -1, 40, 2, 1, 5, 0.5, 0},    {3, -2, 40, 2, 1, 10, 0.5, 0},
      {0.5, 0.5, 30, 0, 1, 5, 0.5, 0}, {1.5, 1, 30, 0, 1, 5, 0.5, 0},
      {1.5, -1, 30, 1, 1, 10, 0.5, 0}, {1.5, -1, 30, 0, 2, 4, 0.5, 0},
      {3, -2, 30, 2, 2, 4, 0.5, 0},    {1, 1, 90, 3, 1, 5, 0.5, 0},
      {1, -1, 90, 3, 2, 3, 0.5, 0},
  };
  for (size_t k = 0; k < sizeof rides / sizeof *rides; k++) {
    const double off = take_a_ride(&rides[k], 0);
    CHECK_LE(off, 0.004);
  }
}

// Beneath a ceiling: a stack goes up to it, and down again.
static void a_stack_rides_beneath_a_ceiling(void) {
  const ride up = {3, 1, 20, 2, 1, 3, 0.5, 0};
  CHECK_LE(take_a_ride(&up, 1.503 + 41.0 / 60 + 0.002), 0.004);
}

// At 8 m/s^2 a friction of 0.5 gives 4.9: the stack falls behind by what is lacking, all of it by the same.
static void stacks_fall_behind(void) {
  enum { TALL = 4, FRAMES = 30 };
  stage s = stage_begin();
  nsvcd_world_mover m[TALL];
  const size_t train = stage_add(&s, thing_box(12, 4, 0.2), pose_of(0, 0, -0.1), 0);
  double at = 0;
  for (int k = 0; k < TALL; k++) m[k] = add_cube(&s, 0, 0, 0.2515 + 0.5015 * k, 1, 1);
  for (int f = 0; f < 60; f++) step(&s, m, TALL, &earth);
  for (int f = 0; f < FRAMES; f++) {
    at += 8.0 * (f + 1) / 3600;
    const nsvcd_pose to = pose_of(at, 0, -0.1);
    CHECK_EQ(nsvcd_world_drive(s.world, train, &to), NSVCD_OK);
    CHECK_EQ(step(&s, m, TALL, &earth).caught, 0);
    keep_apart(&s, m, TALL);
  }
  const double gone = 0.5 * 4.905 * FRAMES * FRAMES / 3600;
  for (int k = 0; k < TALL; k++) {
    const nsvcd_pose now = stage_pose(&s, m[k].id);
    CHECK_NEAR(now.position[0], gone, 0.06);
    CHECK_NEAR(now.position[2], 0.251 + 0.501 * k, 0.01);
  }
  stage_end(&s);
}

// What is carried goes no farther than a wall, and all that stands on it stays with it. A character on a
// stack is carried as the stack is. What lies beside the platform is pushed out of the way.
static void who_cannot_be_carried_stays(void) {
  for (int kind = 0; kind < 3; kind++) {
    stage s = stage_begin();
    nsvcd_world_mover m[5];
    size_t count = 3;
    add_floor(&s);
    const size_t train = stage_add(&s, thing_box(4, 2, 0.2), pose_of(0, 0, 0.111), 0);
    for (int k = 0; k < 3; k++) m[k] = add_cube(&s, 1.2, 0, 0.4635 + 0.5015 * k, 1, 1);
    if (kind == 0) stage_add(&s, thing_box(0.5, 4, 6), pose_of(2.4, 0, 3.5), 1);
    if (kind == 1) {
      m[count] = add_cube(&s, 1.2, 0, 0.4635 + 0.5015 * 3, 0, 0);
      m[count++].how.up[2] = 1;
    }
    if (kind == 2) m[count++] = add_cube(&s, 2.5, 0, 0.2515, 1, 1);
    for (int f = 0; f < 60; f++) step(&s, m, count, &earth);
    double at = 0;
    for (int f = 0; f < 60; f++) {
      at += 1.0 / 60 * fmin(1, (f + 1) / 20.0);
      const nsvcd_pose to = pose_of(at, 0, 0.111);
      CHECK_EQ(nsvcd_world_drive(s.world, train, &to), NSVCD_OK);
      CHECK_EQ(step(&s, m, count, &earth).caught, 0);
      keep_apart(&s, m, count);
    }
    for (size_t k = 0; k < count; k++) {
      const nsvcd_pose now = stage_pose(&s, m[k].id);
      if (kind == 2 && k == 3) {
        CHECK_GE(now.position[0], 2.25 + at - 0.01);
        continue;
      }
      CHECK_NEAR(now.position[0], kind == 0 ? 1.899 : 1.2 + at, 0.02);
      CHECK_NEAR(now.position[2], 0.463 + 0.501 * (double)k, 0.01);
    }
    stage_end(&s);
  }
}

// What falls on a stack that goes down, or up, comes to rest there.
static void what_lands_on_a_stack_rides(void) {
  for (int kind = 0; kind < 2; kind++) {
    stage s = stage_begin();
    nsvcd_world_mover m[3];
    const double speed = kind ? 1 : -1;
    const size_t lift = stage_add(&s, thing_box(4, 4, 0.2), pose_of(0, 0, -0.1), 0);
    double at = 0;
    for (int k = 0; k < 3; k++) m[k] = add_cube(&s, 0, 0, k == 2 ? 1.6 : 0.2515 + 0.5015 * k, 1, 1);
    for (int f = 0; f < 120; f++) {
      at += speed / 60 * fmin(1, f / 20.0);
      const nsvcd_pose to = pose_of(0, 0, at - 0.1);
      CHECK_EQ(nsvcd_world_drive(s.world, lift, &to), NSVCD_OK);
      CHECK_EQ(step(&s, m, 3, &earth).caught, 0);
      keep_apart(&s, m, 3);
    }
    for (int k = 0; k < 3; k++)
      CHECK_NEAR(stage_pose(&s, m[k].id).position[2], at + 0.251 + 0.501 * k, 0.004);
    stage_end(&s);
  }
}

// A crowd on a platform that goes about, rises, sinks and tilts, between walls and beneath a beam: what was
// clear of all is so after each frame, or is told as caught.
static void a_crowd_is_carried_about(void) {
  enum { CROWD = 10 };
  for (int trial = 0; trial < 3; trial++) {
    stage s = stage_begin();
    nsvcd_world_mover m[CROWD];
    int caught = 0;
    const size_t floor = stage_add(&s, thing_box(4, 4, 0.2), pose_of(0, 0, -0.1), 0);
    stage_add(&s, thing_box(0.5, 9, 9), pose_of(2.2, 0, 0), 1);
    stage_add(&s, thing_box(9, 0.5, 9), pose_of(0, -2.2, 0), 1);
    stage_add(&s, thing_box(0.3, 9, 0.3), pose_of(-0.5, 0, 2.6), 1);
    for (int k = 0; k < CROWD; k++) {
      m[k] = k == 9 ? add_cube(&s, 0, -0.7, 0.26, 0, 0)
                    : add_cube(&s, 0.6 * (k % 3) - 0.6, 0.6 * (k / 3 % 2), 0.26 + 0.502 * (k / 6),
                               1, 1);
    }
    m[9].how.up[2] = 1;
    m[9].push_mass = 40;
    for (int f = 0; f < 150; f++) {
      const double t = f / 60.0 * (1 + 0.5 * trial);
      double before[CROWD];
      nsvcd_pose to = turned(0.5 * sin(2 * t), 0.4 * sin(1.3 * t), 0.5 * sin(1.7 * t) - 0.1, trial,
                             trial == 2 ? 0.8 * t : 0.15 * sin(t));
      for (int k = 0; k < CROWD; k++) before[k] = stage_apart(&s, m[k].id);
      CHECK_EQ(nsvcd_world_drive(s.world, floor, &to), NSVCD_OK);
      m[9].velocity.linear[0] = (float)sin(t);
      caught += (int)step(&s, m, CROWD, &earth).caught;
      for (int k = 0; k < CROWD; k++)
        if (before[k] >= (double)NEAR - 1e-5 && !m[k].answer.caught)
          CHECK_GE(stage_apart(&s, m[k].id), (double)NEAR * 0.5 - 1e-5);
    }
    CHECK_LE(caught, 100);
    stage_end(&s);
  }
}

// ---- momentum

static double momentum_of(const nsvcd_world_mover *movers, int axis, size_t count) {
  double out = 0;
  for (size_t k = 0; k < count; k++)
    out += (double)movers[k].how.mass * (double)movers[k].velocity.linear[axis];
  return out;
}
// Of cubes, whose inertia is the same about all axes.
static double energy_of(const nsvcd_world_mover *movers, size_t count) {
  double out = 0;
  for (size_t k = 0; k < count; k++) {
    for (int i = 0; i < 3; i++) {
      const double v = (double)movers[k].velocity.linear[i];
      const double w = (double)movers[k].velocity.angular[i];
      out += 0.5 * ((double)movers[k].how.mass * v * v + (double)movers[k].how.inertia[i] * w * w);
    }
  }
  return out;
}

// Two meet head-on: by paper, whoever is moved first.
static void two_share_their_momentum(void) {
  for (int trial = 0; trial < 48; trial++) {
    stage s = stage_begin();
    const float heavy = trial % 3 == 0 ? 1 : trial % 3 == 1 ? 4 : 0.25f;
    const float bounces = trial % 2 ? 1 : 0;
    const float other = trial / 12 % 2 ? -2 : 0;
    nsvcd_world_mover m[2] = {add_cube(&s, -0.4, 0, 0, 1, 0), add_cube(&s, 0.4, 0, 0, heavy, 0)};
    const int first = trial / 6 % 2;
    m[0].velocity.linear[0] = 2;
    m[1].velocity.linear[0] = other;
    m[0].how.restitution = m[1].how.restitution = bounces;
    const double sum = 2 + (double)heavy * (double)other;
    const double joint = sum / (1 + (double)heavy);
    const double energy = energy_of(m, 2);
    if (first) {
      const nsvcd_world_mover swapped = m[0];
      m[0] = m[1];
      m[1] = swapped;
    }
    for (int f = 0; f < 30; f++) {
      step(&s, m, 2, &space);
      keep_apart(&s, m, 2);
      CHECK_LE(energy_of(m, 2), energy * (1 + 1e-6));
      CHECK_NEAR(momentum_of(m, 0, 2), sum, 1e-4);
    }
    CHECK_NEAR(m[first].velocity.linear[0], joint - (double)bounces * (2 - joint), 0.02);
    CHECK_NEAR(m[!first].velocity.linear[0], joint - (double)bounces * ((double)other - joint),
               0.02);
    stage_end(&s);
  }
}

// A crowd that flies about, and turns, in a room without gravity: no energy is ever gained.
static void a_crowd_gains_no_energy(void) {
  enum { CROWD = 12 };
  for (int kind = 0; kind < 4; kind++) {
    stage s = stage_begin();
    nsvcd_world_mover m[CROWD];
    for (int axis = 0; axis < 3; axis++) {
      for (int side = -1; side <= 1; side += 2) {
        double at[3] = {0, 0, 0}, size[3] = {5, 5, 5};
        at[axis] = 1.8 * side;
        size[axis] = 0.5;
        stage_add(&s, thing_box(size[0], size[1], size[2]), pose_of(at[0], at[1], at[2]), 1);
      }
    }
    for (int k = 0; k < CROWD; k++) {
      m[k] = add_cube(&s, 0.9 * (k % 3 - 1), 0.9 * (k / 3 % 3 - 1), 0.9 * (k / 9 - 0.5),
                      k % 2 ? 1.0f : 10.0f, kind % 2);
      m[k].how.friction = 0;
      m[k].how.restitution = kind / 2 ? 1 : 0.5f;
      for (int i = 0; i < 3; i++) m[k].velocity.linear[i] = (float)uniform(-8, 8);
    }
    double energy = energy_of(m, CROWD);
    for (int f = 0; f < 60; f++) {
      step(&s, m, CROWD, &space);
      const double now = energy_of(m, CROWD);
      CHECK_LE(now, energy * (1 + 1e-4));
      energy = now;
      if (f % 20 == 19) keep_apart(&s, m, CROWD);
    }
    stage_end(&s);
  }
}

// Two balls, or boxes face on, from distances and with clearances, one of them first: as on paper.
static void two_movers_bounce(void) {
  static const float masses[3][2] = {{1, 1}, {1, 10}, {10, 1}}, clearances[3] = {0, 0.002f, 0.006f};
  for (int n = 0; n < 3 * 3 * 3 * 2 * 4 * 2; n++) {
    stage s = stage_begin();
    nsvcd_world_mover m[2];
    const int order = n / 3 % 2, shape = n / 6 % 4, ia = order, ib = 1 - order;
    const double e = 0.5 * (n / 24 % 3), aside = shape < 3 ? 0.05 * shape : 0;
    const float *mass = masses[n / 72 % 3];
    const double speed = n / 216 ? -2 : 0, at[2] = {0, 1.5 + 0.0071 * (n % 37)};
    for (int k = 0; k < 2; k++) {
      const int i = order ? 1 - k : k;
      memset(&m[k], 0, sizeof m[k]);
      m[k].id = stage_add(&s, shape < 3 ? thing_ball(0.2f) : thing_box(0.4, 0.4, 0.4),
                          pose_of(at[i], i * aside, 0), 0);
      m[k].how.mass = mass[i];
      for (int j = 0; j < 3; j++) m[k].how.inertia[j] = mass[i] * 0.02f;
      m[k].how.restitution = (float)e;
      m[k].how.clearance = clearances[n % 3];
      m[k].velocity.linear[0] = (float)(i ? speed : 5);
    }
    const double before = energy_of(m, 2);
    for (int f = 0; f < 60; f++) step(&s, m, 2, &space);
    const double sine = shape < 3 ? aside / (0.4 + 1.5 * (double)m[0].how.clearance) : 0;
    const double shared = (double)mass[0] * (double)mass[1] / (double)(mass[0] + mass[1]);
    const double push = shared * (1 + e) * (5 - speed) * (1 - sine * sine);
    const double paper[2] = {5 - push / (double)mass[0], speed + push / (double)mass[1]};
    CHECK_NEAR(m[ia].velocity.linear[0], paper[0], 0.03 * (5 - speed));
    CHECK_NEAR(m[ib].velocity.linear[0], paper[1], 0.03 * (5 - speed));
    CHECK_LE(energy_of(m, 2), before * (1 + 1e-5));
    stage_end(&s);
  }
}

// One is thrown up at another that falls: gravity changes nothing between them.
static void a_bounce_in_the_air(void) {
  for (int n = 0; n < 64; n++) {
    stage s = stage_begin();
    nsvcd_world_mover m[2] = {add_cube(&s, 0, 0, 0.5, 1, 0),
                              add_cube(&s, 0, 0, 1.6 + 0.007 * n, 2, 0)};
    for (int k = 0; k < 2; k++) m[k].how.restitution = 0.5f;
    m[0].velocity.linear[2] = 6;
    for (int f = 0; f < 30; f++) step(&s, m, 2, &earth);
    const double v[2] = {(double)m[0].velocity.linear[2], (double)m[1].velocity.linear[2]};
    CHECK_NEAR(v[1] - v[0], 3, 0.26);  // the lower one has had its gravity of the frame
    CHECK_NEAR((v[0] + 2 * v[1]) / 3, 2 - 9.81 / 2, 0.01);
    stage_end(&s);
  }
}

// To and fro between two walls, several times in a frame: each bounce takes what it is due.
static void bounces_between_walls(void) {
  stage s = stage_begin();
  for (int side = -1; side <= 1; side += 2)
    stage_add(&s, thing_box(1, 5, 5), pose_of(0.8 * side, 0, 0), 1);
  nsvcd_world_mover m = add_cube(&s, 0, 0, 0, 1, 0);
  m.how.restitution = 1;
  m.velocity.linear[0] = 11;
  for (int f = 0; f < 60; f++) {
    m.velocity.linear[1] = m.velocity.linear[2] = 0;
    m.velocity.linear[0] = m.velocity.linear[0] < 0 ? -11 : 11;
    step(&s, &m, 1, &space);
    double taken = 0;
    for (size_t k = 0; k < m.answer.contact_count; k++)
      taken += (double)m.answer.contacts[k].impulse;
    CHECK_LE(taken, 4 * 22.1);
  }
  stage_end(&s);
}

// ---- sleep

static void what_sleeps_wakes(void) {
  for (int how = 0; how < 8; how++) {
    stage s = stage_begin();
    const size_t floor = add_floor(&s);
    nsvcd_world_mover m[3] = {add_cube(&s, 0, 0, 0.252, 1, 1), add_cube(&s, 0, 0, 0.754, 1, 1),
                              add_cube(&s, 2, 0, 0.252, 1, 1)};
    size_t count = 2;
    for (int f = 0; f < 60; f++) step(&s, m, 2, &earth);
    CHECK(m[0].asleep && m[1].asleep);
    const nsvcd_pose was = stage_pose(&s, m[1].id);
    const nsvcd_pose lower = pose_of(0, 0, -0.9);
    const nsvcd_pose aside = pose_of(3, 3, 0.2512);
    const nsvcd_pose lowered = pose_of(0, 0, -0.55);
    if (how == 0) stage_remove(&s, floor);
    if (how == 1) CHECK_EQ(nsvcd_world_move(s.world, floor, &lower), NSVCD_OK);
    if (how == 2) CHECK_EQ(nsvcd_world_move(s.world, m[0].id, &aside), NSVCD_OK);
    if (how == 3) CHECK_EQ(nsvcd_world_drive(s.world, floor, &lowered), NSVCD_OK);
    if (how == 4) m[1].velocity.linear[2] = 3;
    if (how == 5) m[2].velocity.linear[0] = -20;
    if (how >= 5) count = 3;
    if (how == 6) m[0].asleep = 0;
    for (int f = 0; f < 12; f++) step(&s, m, count, &earth);
    const nsvcd_pose now = stage_pose(&s, m[1].id);
    double moved = 0;
    for (int k = 0; k < 3; k++)
      moved = fmax(moved, fabs((double)now.position[k] - (double)was.position[k]));
    if (how < 6) CHECK_GE(moved, 0.01);
    if (how == 5) CHECK_LE(stage_pose(&s, m[0].id).position[0], -0.05);
    if (how == 6) CHECK(m[0].asleep && m[1].asleep);
    if (how >= 6) CHECK_EQ(moved, 0);
    keep_apart(&s, m, count);
    stage_end(&s);
  }
}

static void who_never_sleeps(void) {
  stage s = stage_begin();
  add_floor(&s);
  nsvcd_world_mover m[3] = {add_cube(&s, 0, 0, 0.252, 1, 1), add_cube(&s, 2, 0, 3, 1, 1),
                            add_cube(&s, 0, 0, 0.754, 1, 1)};
  m[0].sleepless = m[2].sleepless = 1;
  m[1].asleep = 1;
  for (int f = 0; f < 60; f++) step(&s, m, 3, &earth);
  // what lies on another does not press it on
  for (int k = 0; k < 3; k += 2) {
    CHECK_EQ(m[k].asleep, 0);
    CHECK_EQ(m[k].answer.rests, 1);
    CHECK_EQ(m[k].velocity.linear[2], 0);
  }
  CHECK_EQ(m[1].asleep, 1);
  CHECK_EQ(stage_pose(&s, m[1].id).position[2], 3);
  stage_end(&s);
}

// ---- characters, driven movers

static void a_character_pushes(void) {
  for (int kind = 0; kind < 2; kind++) {
    stage s = stage_begin();
    add_floor(&s);
    nsvcd_world_mover m[2] = {add_cube(&s, 0, 0, 0.252, 0, 0), add_cube(&s, 1, 0, 0.252, 10, 1)};
    m[0].how.up[2] = 1;
    m[0].push_mass = kind ? 60.0f : 0;
    for (int f = 0; f < 120; f++) {
      m[0].velocity.linear[0] = f < 30 ? 0 : 1;
      step(&s, m, 2, &earth);
      if (f == 29) CHECK_EQ(m[1].asleep, 1);
      if (f % 30 == 29) keep_apart(&s, m, 2);
    }
    const double gone = (double)stage_pose(&s, m[1].id).position[0] - 1;
    if (kind) CHECK_GE(gone, 0.3);
    if (!kind) CHECK_EQ(gone, 0);
    stage_end(&s);
  }
}

// Wherever it starts, and whatever it and the crate keep between them.
static void a_character_pushes_from_anywhere(void) {
  static const float clearances[4] = {0, 0.002f, 0.01f, 0.02f};
  for (int n = 0; n < 16 * 16; n++) {
    stage s = stage_begin();
    add_floor(&s);
    nsvcd_world_mover m[2] = {add_cube(&s, -0.6 - 0.0041 * (n / 16), 0, 0.28, 0, 0),
                              add_cube(&s, 0, 0, 0.28, 20, 1)};
    m[0].how.up[2] = 1;
    m[0].push_mass = 70;
    for (int k = 0; k < 2; k++)
      m[k].how.clearance = m[k].how.margin = clearances[k ? n % 4 : n / 4 % 4];
    for (int f = 0; f < 60; f++) {
      m[0].velocity.linear[0] = 1.5f;
      step(&s, m, 2, n % 3 ? &earth : &space);
    }
    CHECK_GE(stage_pose(&s, m[1].id).position[0], 0.3);
    stage_end(&s);
  }
}

// Crates that touch, and rub on the floor.
static void a_character_pushes_a_row(void) {
  for (int n = 0; n < 24; n++) {
    const size_t all = n % 2 ? 5 : 4;
    const double apart = 0.501 + 0.0003 * n;
    stage s = stage_begin();
    nsvcd_world_mover m[5];
    add_floor(&s);
    for (size_t k = 0; k < all; k++) {
      m[k] = add_cube(&s, k ? apart * (double)k : -0.05 - 0.003 * n, 0, 0.26, k ? 2 : 0, k > 0);
      m[k].how.clearance = m[k].how.margin = 0;
    }
    m[0].how.up[2] = 1;
    m[0].push_mass = 70;
    for (int f = 0; f < 120; f++) {
      m[0].velocity.linear[0] = 1.5f;
      step(&s, m, all, &earth);
    }
    const double begins = apart * (double)(all - 1);
    CHECK_GE((double)stage_pose(&s, m[all - 1].id).position[0] - begins, all < 5 ? 1 : 0.4);
    stage_end(&s);
  }
}

// With a crate on its head that fell there from some height, and sleeps nearer than its clearance.
static void a_character_jumps_beneath_a_crate(void) {
  for (int n = 0; n < 40; n++) {
    stage s = stage_begin();
    add_floor(&s);
    nsvcd_world_mover m[2] = {add_cube(&s, 0, 0, 0.26, 0, 0),
                              add_cube(&s, 0, 0, 0.78 + 0.0037 * n, 20, 1)};
    m[0].how.up[2] = 1;
    m[0].push_mass = 70;
    m[0].how.clearance = m[0].how.margin = 0.0045f;
    m[1].how.clearance = m[1].how.margin = 0.0026f;
    for (int f = 0; f < 120; f++) step(&s, m, 2, &earth);
    CHECK_EQ(m[1].asleep, 1);
    m[0].velocity.linear[2] = 5;
    for (int f = 0; f < 12; f++) step(&s, m, 2, &earth);
    CHECK_GE(stage_pose(&s, m[0].id).position[2], 0.6);
    CHECK_GE(stage_pose(&s, m[1].id).position[2], 1.1);
    stage_end(&s);
  }
}

static void who_is_driven_goes_there(void) {
  stage s = stage_begin();
  add_floor(&s);
  nsvcd_world_mover m[2] = {add_cube(&s, 0, 0, 0.252, 1, 1), add_cube(&s, 0.6, 0, 0.252, 1, 1)};
  for (int f = 0; f < 30; f++) {
    const nsvcd_pose to = pose_of(0.01 * f, 0, 0.252);
    CHECK_EQ(nsvcd_world_drive(s.world, m[0].id, &to), NSVCD_OK);
    step(&s, m, 2, &earth);
    const nsvcd_pose now = stage_pose(&s, m[0].id);
    CHECK(!memcmp(&now, &to, sizeof now));
  }
  CHECK_GE(stage_pose(&s, m[1].id).position[0], 0.79);
  keep_apart(&s, m, 2);
  stage_end(&s);
}

// ---- whatever the order

// A heap that falls: the array in another order in each frame, nothing overlaps; and without ties of
// heights it makes no difference.
static void any_order_is_safe(void) {
  enum { HEAP = 16 };
  nsvcd_pose ends[2][HEAP];
  for (int shuffled = 0; shuffled < 2; shuffled++) {
    stage s = stage_begin();
    nsvcd_world_mover m[HEAP];
    add_floor(&s);
    for (int k = 0; k < HEAP; k++)
      m[k] = add_cube(&s, 0.3 * (k % 2), 0.2 * (k % 3), 0.3 + 0.55 * k + 0.001 * k * k, 1, 1);
    for (int f = 0; f < 80; f++) {
      for (int k = HEAP - 1; k > 0 && shuffled; k--) {
        const int other = (int)(uniform(0, 1) * k);
        const nsvcd_world_mover mover = m[k];
        m[k] = m[other];
        m[other] = mover;
      }
      step(&s, m, HEAP, &earth);
      if (f % 10 == 9) keep_apart(&s, m, HEAP);
    }
    for (int k = 0; k < HEAP; k++) ends[shuffled][k] = stage_pose(&s, (size_t)k + 2);
    stage_end(&s);
  }
  CHECK(!memcmp(ends[0], ends[1], sizeof ends[0]));
}

// ---- bad input

static void bad_steps_are_refused(void) {
  stage s = stage_begin();
  const size_t floor = add_floor(&s);
  nsvcd_world_mover m[3] = {add_cube(&s, 0, 0, 1, 1, 1), add_cube(&s, 1, 0, 1, 1, 1),
                            add_cube(&s, 2, 0, 1, 1, 1)};
  size_t size;
  void *memory = workspace(&size);
  nsvcd_step_answer answer;
  for (int k = 0; k < 20; k++) {
    nsvcd_world_mover bad[3] = {m[0], m[1], m[2]};
    nsvcd_world_mover kept[3];
    nsvcd_step_options options = earth;
    nsvcd_result code = NSVCD_ERROR_INDEX;
    size_t count = 3;
    size_t at_fault = m[1].id;
    float seconds = FRAME;
    if (k == 0) bad[1].id = at_fault = NSVCD_NOBODY;
    if (k == 1) bad[1].id = at_fault = 99;
    if (k == 2) bad[1].id = at_fault = floor;
    if (k == 3) bad[1].id = at_fault = m[0].id;
    if (k == 4) bad[1].velocity.linear[1] = NAN, code = NSVCD_ERROR_SPEED;
    if (k == 5) bad[1].velocity.angular[1] = HUGE_VALF, code = NSVCD_ERROR_SPEED;
    if (k == 6) bad[1].how.mass = -1, code = NSVCD_ERROR_VALUE;
    if (k == 7) bad[1].push_mass = NAN, code = NSVCD_ERROR_VALUE;
    if (k == 8) bad[1].damping = -1, code = NSVCD_ERROR_VALUE;
    if (k == 9) bad[1].spin_damping = -1, code = NSVCD_ERROR_VALUE;
    if (k == 10)
      bad[1].velocity.linear[2] = -NSVCD_MAX_COORDINATE, at_fault = m[1].id,
      code = NSVCD_ERROR_SPEED;
    if (k >= 11) at_fault = NSVCD_NOBODY;
    if (k == 11) options.gravity[1] = NAN, code = NSVCD_ERROR_VALUE;
    if (k == 12) options.quiet = -1, code = NSVCD_ERROR_SPEED;
    if (k == 13) options.calm = NAN, code = NSVCD_ERROR_TIMES;
    if (k == 14) seconds = 0, code = NSVCD_ERROR_TIMES;
    if (k == 15) seconds = NAN, code = NSVCD_ERROR_TIMES;
    if (k == 16) count = 1000;
    if (k >= 17) code = k == 19 ? NSVCD_ERROR_WORKSPACE : NSVCD_ERROR_ARGUMENT;
    memcpy(kept, bad, sizeof kept);
    memset(&answer, 0, sizeof answer);
    CHECK_EQ(nsvcd_world_step(k == 17 ? NULL : s.world, k == 18 ? NULL : bad, count, &options,
                              seconds, memory, k == 19 ? 64 : size, &answer),
             code);
    CHECK_EQ(answer.refused, at_fault);
    CHECK(!memcmp(kept, bad, sizeof kept));
    for (int n = 0; n < 3; n++) CHECK_EQ(stage_pose(&s, m[n].id).position[2], 1);
  }
  // who is about to leave the coordinates stays, and all others move
  m[1].velocity.linear[0] = 9e5f;
  CHECK_EQ(nsvcd_world_step(s.world, m, 3, &earth, 10, memory, size, &answer), NSVCD_ERROR_POSE);
  CHECK_EQ(answer.refused, m[1].id);
  CHECK_EQ(stage_pose(&s, m[1].id).position[0], 1);
  CHECK_LE(stage_pose(&s, m[2].id).position[2], 0.9);
  // nobody at all, and the other way up, and without an answer
  CHECK_EQ(nsvcd_world_step(s.world, NULL, 0, NULL, FRAME, memory, size, NULL), NSVCD_OK);
  m[1].velocity.linear[0] = 0;
  m[0].asleep = m[2].asleep = 0;
  const nsvcd_step_options up = {{0, 0, 9.81f}, 0, 0};
  for (int f = 0; f < 30; f++) step(&s, m, 3, &up);
  CHECK_GE(stage_pose(&s, m[0].id).position[2], 1);
  stage_end(&s);
}

// ---- masses

static nsvcd_result mass_of(const shapes_mesh *shape, nsvcd_mass *mass) {
  nsvcd_mesh mesh;
  float *narrow = (float *)malloc(3 * shape->vertices * sizeof *narrow);
  if (!narrow) exit(1);
  for (size_t k = 0; k < 3 * shape->vertices; k++) narrow[k] = (float)shape->positions[k];
  mesh.positions = narrow;
  mesh.indices = shape->indices;
  mesh.vertex_count = shape->vertices;
  mesh.triangle_count = shape->triangles;
  const nsvcd_result result = nsvcd_mesh_mass(&mesh, mass);
  free(narrow);
  return result;
}

static void masses_are_those_on_paper(void) {
  for (int kind = 0; kind < 6; kind++) {
    shapes_mesh shape;
    nsvcd_mass mass;
    memset(&shape, 0, sizeof shape);
    if (kind < 4) shapes_box_at(&shape, 1, 2, 3, 1, 2, 0.5);
    if (kind == 1) shape.triangles--;
    if (kind == 2) shape.triangles -= 4;  // a pair of faces: areas still add up to nothing
    if (kind == 3)
      for (size_t k = 0; k < shape.triangles; k++) {
        const uint32_t first = shape.indices[3 * k];
        shape.indices[3 * k] = shape.indices[3 * k + 1];
        shape.indices[3 * k + 1] = first;
      }
    if (kind == 4) shapes_cylinder(&shape, 0.5, 2, 256);
    if (kind == 5) {
      shapes_box_at(&shape, -3, 0, 0, 1, 1, 1);
      shapes_box_at(&shape, 1, 0, 0, 1, 1, 3);
    }
    CHECK_EQ(mass_of(&shape, &mass), NSVCD_OK);
    CHECK_EQ(mass.is_of_box, kind > 0 && kind < 4);
    if (kind < 4) {
      CHECK_NEAR(mass.volume, 1, 1e-5);
      for (int k = 0; k < 3; k++) CHECK_NEAR(mass.centre[k], k + 1, 1e-5);
      CHECK_NEAR(mass.inertia[0], 4.25 / 12, 1e-5);
      CHECK_NEAR(mass.inertia[1], 1.25 / 12, 1e-5);
      CHECK_NEAR(mass.inertia[2], 5.0 / 12, 1e-5);
    }
    if (kind == 4) {
      CHECK_NEAR(mass.volume, 0.5 * SHAPES_PI, 1e-3);
      CHECK_NEAR(mass.inertia[2], 0.125, 1e-4);
      CHECK_NEAR(mass.inertia[0], 0.0625 + 1.0 / 3, 1e-3);
    }
    if (kind == 5) {
      CHECK_NEAR(mass.volume, 4, 1e-5);
      CHECK_NEAR(mass.centre[0], 0, 1e-5);
      CHECK_NEAR(mass.inertia[1], (1.0 / 6 + 9) / 4 + 0.75 * (10.0 / 12 + 1), 1e-4);
    }
    shape.indices[0] = 1000000;
    CHECK_EQ(mass_of(&shape, &mass), NSVCD_ERROR_INDEX);
    shape.triangles = 0;
    CHECK_EQ(mass_of(&shape, &mass), NSVCD_ERROR_EMPTY);
    shapes_free(&shape);
  }
  CHECK_EQ(nsvcd_mesh_mass(NULL, NULL), NSVCD_ERROR_ARGUMENT);
}

void test_step(void) {
  RUN(seven_stacks_of_five_stand);
  RUN(stacks_fall_asleep);
  RUN(heaps_fall_asleep);
  RUN(a_new_world_begins_afresh);
  RUN(what_is_saved_goes_on_as_it_did);
  RUN(an_answer_tells_where_it_is);
  RUN(stacks_ride);
  RUN(a_stack_rides_beneath_a_ceiling);
  RUN(stacks_fall_behind);
  RUN(who_cannot_be_carried_stays);
  RUN(what_lands_on_a_stack_rides);
  RUN(a_crowd_is_carried_about);
  RUN(two_share_their_momentum);
  RUN(two_movers_bounce);
  RUN(a_bounce_in_the_air);
  RUN(bounces_between_walls);
  RUN(a_crowd_gains_no_energy);
  RUN(what_sleeps_wakes);
  RUN(who_never_sleeps);
  RUN(a_character_pushes);
  RUN(a_character_pushes_from_anywhere);
  RUN(a_character_pushes_a_row);
  RUN(a_character_jumps_beneath_a_crate);
  RUN(who_is_driven_goes_there);
  RUN(any_order_is_safe);
  RUN(bad_steps_are_refused);
  RUN(masses_are_those_on_paper);
}

CHECK_ALONE(test_step)
