// Over all values of the joints between two parts: what is said of all of them against dense samples
// and an oracle in double; narrow ranges; joints of all kinds; bad input.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "check.h"
#include "robot_scene.h"

void test_ranges(void);

static nsvcd_range_answer range_of(const robot *r, nsvcd_body_pair pair, float clearance,
                                   size_t boxes) {
  nsvcd_range_options o;
  nsvcd_range_answer out;
  memset(&o, 0, sizeof o);
  memset(&out, 0, sizeof out);
  o.clearance = clearance;
  o.boxes = boxes;
  const size_t size = nsvcd_pair_range_size(r->checker, pair, &o);
  void *memory = malloc(size);
  CHECK(size > 0);
  CHECK_EQ(nsvcd_pair_range(r->checker, pair, &o, memory, size, &out), NSVCD_OK);
  free(memory);
  return out;
}

// A tree of joints about as long as its parts, which often overlap, turned by up to `limit`.
static void short_robot(robot *r, shapes_rng *rng, float reach, double limit) {
  do robot_random(r, rng);
  while (r->scene.joint_count < 2);
  for (size_t i = 0; i < r->scene.joint_count; i++) {
    r->joints[i].low = -limit;
    r->joints[i].high = shapes_pick(rng, 8) ? limit : -limit;
    r->parts[i].scale = 0;
    for (int k = 0; k < 3; k++) {
      r->joints[i].origin.position[k] *= reach;
      if (r->shape[i] != FAR_SHAPE) r->parts[i].pose.position[k] *= reach;
    }
  }
  robot_open(r);
}

// Whatever is said of all configurations holds in those that are drawn; and those named are as they
// are said to be.
static void ranges_are_right(void) {
  static robot r;
  shapes_rng rng = {17};
  size_t count[4] = {0, 0, 0, 0};
  for (size_t trial = 0; trial < check_many(60); trial++) {
    short_robot(&r, &rng, trial % 2 ? 1 : 0.1f, trial % 4 < 2 ? 3 : 0.3);
    const float clearance = trial % 3 ? 0 : 0.01f;
    for (uint32_t b = 1; b < r.scene.part_count && b < 4; b++) {
      const nsvcd_body_pair pair = {b - 1 - (b > 1 && trial % 5 == 0), b};
      const nsvcd_range_answer a = range_of(&r, pair, clearance, 300);
      const double kept = (double)clearance;
      count[a.meeting]++;
      if (a.has_free) CHECK(robot_apart(&r, &pair, a.free, 0.1) > kept - 1e-9);
      if (a.has_hit) CHECK(robot_apart(&r, &pair, a.hit, 0.1) < kept + 1e-6);
      CHECK_EQ(a.meeting == NSVCD_MEETS_SOMETIMES, a.has_free && a.has_hit);
      if (a.meeting != NSVCD_MEETS_NEVER && a.meeting != NSVCD_MEETS_ALWAYS) continue;
      CHECK(!(a.open > 0));
      for (int n = 0; n < 400; n++) {
        double q[NSVCD_MAX_JOINTS];
        for (size_t j = 0; j < r.scene.joint_count; j++) {
          const int is_endless = r.joints[j].kind == NSVCD_JOINT_CONTINUOUS;
          const double low = is_endless ? -4 : r.joints[j].low;
          q[j] = shapes_uniform(&rng, low, is_endless ? 4 : r.joints[j].high);
        }
        const double apart = robot_apart(&r, &pair, q, 0.1);
        CHECK(a.meeting == NSVCD_MEETS_NEVER ? apart > kept : apart <= kept + 1e-9);
      }
    }
    free(r.memory);
  }
  for (int n = 1; n < 4; n++) CHECK(count[n] > 5);
}

// How near two parts come in a random walk that only goes nearer, from one of the joints' values.
static double nearest_of(const robot *r, const nsvcd_body_pair *pair, shapes_rng *rng, double *q) {
  double nearest = robot_apart(r, pair, q, 10);
  double step = 0.3;
  for (int n = 0; n < 160; n++) {
    double next[NSVCD_MAX_JOINTS];
    for (size_t j = 0; j < r->scene.joint_count; j++) {
      const double to = q[j] + step * shapes_uniform(rng, -1, 1);
      next[j] = fmax(r->joints[j].low, fmin(r->joints[j].high, to));
    }
    const double apart = robot_apart(r, pair, next, 10);
    step *= apart < nearest ? 1.2 : 0.95;
    if (!(apart < nearest)) continue;
    nearest = apart;
    memcpy(q, next, sizeof next);
  }
  return nearest;
}

// With a clearance a little above the least distance that a descent finds, never is not the answer.
static void ranges_see_the_nearest(void) {
  static robot r;
  shapes_rng rng = {41};
  size_t asked = 0;
  size_t never = 0;
  for (size_t trial = 0; trial < check_many(60); trial++) {
    robot_random_of(&r, &rng, 2 + (size_t)shapes_pick(&rng, 3));
    const uint32_t last = (uint32_t)r.scene.joint_count - 1;
    for (size_t i = 0; i <= last; i++) {
      const double middle = shapes_uniform(&rng, -2, 2);
      const double half = shapes_uniform(&rng, 0.1, 1.3);
      r.joints[i].kind = NSVCD_JOINT_REVOLUTE;
      r.joints[i].parent = (uint32_t)i;
      r.joints[i].low = middle - half;
      r.joints[i].high = middle + half;
      r.parts[i].scale = 0;
    }
    const nsvcd_body_pair pair = {0, last};
    robot_open(&r);
    double least = 10;
    for (int n = 0; n < 12; n++) {
      double q[NSVCD_MAX_JOINTS];
      for (size_t j = 0; j <= last; j++)
        q[j] = shapes_uniform(&rng, r.joints[j].low, r.joints[j].high);
      least = fmin(least, nearest_of(&r, &pair, &rng, q));
    }
    if (least > 0.02) {
      asked++;
      CHECK(range_of(&r, pair, (float)(1.002 * least + 1e-5), 400).meeting != NSVCD_MEETS_NEVER);
      never += range_of(&r, pair, (float)(0.5 * least), 400).meeting == NSVCD_MEETS_NEVER;
    }
    free(r.memory);
  }
  CHECK_GE(asked, 10);
  CHECK_GE(2 * never, asked);
}

// The elbow is bent in the middle of its range. The tip touches the post where the arm is straight,
// and turned the other way.
static void ranges_see_an_arm_straightened(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  robot_bare(&r, NSVCD_JOINT_REVOLUTE, 2, 2, 0.2);
  for (int j = 0; j < 2; j++) r.joints[j].axis[2] = 1;
  r.joints[1].origin.position[0] = 1;
  r.joints[1].low = 0;
  r.joints[1].high = 3.1;
  for (int n = 0; n < 2; n++) r.parts[n].body = robot_shapes()[0].body;
  for (int n = 0; n < 2; n++) r.parts[n].scale = 0.1f;
  r.parts[1].link = 2;
  r.parts[1].pose.position[0] = 1;
  r.parts[0].pose.position[0] = (float)(2 * cos(0.19));
  r.parts[0].pose.position[1] = (float)(-2 * sin(0.19));
  robot_open(&r);
  CHECK(range_of(&r, pair, 0, 2000).meeting != NSVCD_MEETS_NEVER);
  free(r.memory);
  r.parts[0].pose.position[0] *= 1.02f;
  r.parts[0].pose.position[1] *= 1.02f;
  robot_open(&r);
  CHECK_EQ(range_of(&r, pair, 0, 2000).meeting, NSVCD_MEETS_NEVER);
  free(r.memory);
}

// A cube in a plate, which it leaves in a small hole alone: that is not always.
static void ranges_see_a_hole(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  const double holes[3][2] = {{0.3, 0.25}, {-0.21, 0.33}, {0.11, -0.37}};
  for (int n = 0; n < 3; n++) {
    const double x = holes[n][0];
    const double y = holes[n][1];
    const double half = 0.065;  // of the hole; the cube's is 0.05
    shapes_mesh plate;
    memset(&plate, 0, sizeof plate);
    shapes_box_at(&plate, (x - half - 1) / 2, 0, 0, x - half + 1, 2, 0.2);
    shapes_box_at(&plate, (x + half + 1) / 2, 0, 0, 1 - x - half, 2, 0.2);
    shapes_box_at(&plate, 0, (y - half - 1) / 2, 0, 2, y - half + 1, 0.2);
    shapes_box_at(&plate, 0, (y + half + 1) / 2, 0, 2, 1 - y - half, 0.2);
    robot_bare(&r, NSVCD_JOINT_PRISMATIC, 2, 2, 0.45);
    r.joints[0].axis[0] = r.joints[1].axis[1] = 1;
    r.parts[0].body = body_of(&plate, NULL);
    r.parts[1].body = robot_shapes()[0].body;
    r.parts[1].link = 2;
    robot_open(&r);
    CHECK(range_of(&r, pair, 0, 3000).meeting != NSVCD_MEETS_ALWAYS);
    free(r.memory);
    // where the hole is not
    r.joints[0].high = x - 2 * half;
    r.joints[0].low = x - 0.4;
    robot_open(&r);
    CHECK_EQ(range_of(&r, pair, 0, 3000).meeting, NSVCD_MEETS_ALWAYS);
    free(r.memory);
    nsvcd_body_free(r.parts[0].body, NULL);
    shapes_free(&plate);
  }
}

// A cube that slides along an arm leaves a block where the arm points out of it, and is longest: in no
// corner of both ranges, nor in their middle.
static void ranges_see_the_end_of_a_block(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  shapes_mesh block;
  memset(&block, 0, sizeof block);
  shapes_box_at(&block, 0, 0, 0, 2, 4, 1);
  robot_bare(&r, NSVCD_JOINT_REVOLUTE, 2, 2, 0.5);
  r.joints[0].axis[2] = 1;
  r.joints[1].kind = NSVCD_JOINT_PRISMATIC;
  r.joints[1].axis[0] = 1;
  r.joints[1].low = 0.95;
  r.parts[0].body = body_of(&block, NULL);
  r.parts[1].body = robot_shapes()[0].body;
  r.parts[1].link = 2;
  for (int n = 0; n < 2; n++) {
    r.joints[1].high = n ? 1.045 : 1.0505;
    robot_open(&r);
    const nsvcd_range_answer a = range_of(&r, pair, 0, 0);
    if (n == 0) CHECK(a.meeting != NSVCD_MEETS_ALWAYS);
    if (n == 1) CHECK_EQ(a.meeting, NSVCD_MEETS_ALWAYS);
    free(r.memory);
  }
  nsvcd_body_free(r.parts[0].body, NULL);
  shapes_free(&block);
}

// A box that a joint slides past another one, which it meets in a narrow range of its values.
static void ranges_narrow(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  for (int parts = 0; parts < 2; parts++) {
    robot_bare(&r, NSVCD_JOINT_PRISMATIC, 1, 2, 1);
    r.joints[0].axis[0] = 1;
    for (int n = 0; n < 2; n++) r.parts[n].body = robot_shapes()[0].body;
    r.parts[1].link = 1;
    // they meet from -0.1 to 0.1, the lengths of both boxes
    r.joints[0].low = parts ? -0.1 + 1e-4 : -100.0987;
    r.joints[0].high = parts ? 0.1 + 1e-4 : -0.0987;
    robot_open(&r);
    const nsvcd_range_answer a = range_of(&r, pair, 0, 0);
    CHECK_EQ(a.joints, 1);
    CHECK_EQ(a.meeting, NSVCD_MEETS_SOMETIMES);
    free(r.memory);
    r.joints[0].low = parts ? -0.0999 : -100;
    r.joints[0].high = parts ? 0.0999 : -0.1001;
    robot_open(&r);
    CHECK_EQ(range_of(&r, pair, 0, 0).meeting, parts ? NSVCD_MEETS_ALWAYS : NSVCD_MEETS_NEVER);
    CHECK_EQ(range_of(&r, pair, 2e-4f, 0).meeting,
             parts ? NSVCD_MEETS_ALWAYS : NSVCD_MEETS_SOMETIMES);
    free(r.memory);
  }
}

// How far apart a plane has two parts at least, in a box of values, (2, joints between them); and how
// far they are, of samples; NULL: not asked.
static double parting_of(const robot *r, nsvcd_body_pair pair, const double *box, shapes_rng *rng,
                         double *least) {
  static nsvcd__span s;
  nsvcd__links at;
  nsvcd__span_begin(&r->scene, pair, &s);
  const size_t size = nsvcd_checker_size(&s.scene);
  void *memory = malloc(size);
  CHECK_EQ(nsvcd_checker_open(&s.scene, memory, size, &s.checker), NSVCD_OK);
  nsvcd__take_box(&s, box);
  nsvcd__place_links(s.checker, s.at, &at);
  const nsvcd__rider riders[2] = {nsvcd__rider_of(s.checker, &at, 0),
                                  nsvcd__rider_of(s.checker, &at, 1)};
  nsvcd__arms_between(&s, &at, riders);
  const nsvcd__parting parting = nsvcd__best_parting(&s, &at, riders, 1e9);
  if (least) *least = 1.5 * parting.apart;
  for (size_t n = 0; n < 300 && least && parting.apart > 0; n++) {
    double q[NSVCD_MAX_JOINTS];
    memcpy(q, s.at, sizeof q);
    for (size_t k = 0; k < s.joints; k++) {
      const double random = shapes_uniform(rng, 0, 1);
      const double share = n % 2 ? random : random < 0.5;
      q[s.path[k]] = s.low[k] + share * (s.high[k] - s.low[k]);
    }
    nsvcd__follow(&r->scene, 1, q);
    *least = fmin(*least, robot_apart(r, &pair, q, *least));
  }
  free(memory);
  return parting.apart - s.beyond;
}

// In all of a box of values two parts are as far apart as the plane that is said to part them makes
// them.
static void planes_part_no_less(void) {
  static robot r;
  shapes_rng rng = {23};
  size_t told = 0;
  size_t tight = 0;
  for (size_t trial = 0; trial < check_many(400); trial++) {
    double box[2 * NSVCD_MAX_JOINTS], least;
    robot_random_of(&r, &rng, 2 + (size_t)shapes_pick(&rng, 5));
    const nsvcd_body_pair pair = {0, (uint32_t)r.scene.joint_count - 1};
    size_t way[NSVCD_MAX_JOINTS];
    const size_t joints =
        nsvcd__path_between(&r.scene, r.parts[pair.a].link, r.parts[pair.b].link, way);
    const double wide = pow(10, shapes_uniform(&rng, -2, 0.2));
    for (size_t k = 0; k < joints; k++) {
      const double middle = shapes_uniform(&rng, -1, 1);
      const double half = wide * shapes_uniform(&rng, 0, 1);
      box[k] = middle - half;
      box[joints + k] = middle + half;
    }
    const double apart = parting_of(&r, pair, box, &rng, &least);
    CHECK(!(apart > 0) || least >= apart);
    told += apart > 0;
    tight += apart > 0.7 * least;
  }
  CHECK_GE(told, check_many(400) / 10);
  CHECK_GE(tight, 5);
}

// An arm that is stretched away from a wall bends towards it: by (5 h^2) / 2 of its length if both of
// its joints turn by h.
static void planes_know_what_bends(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  shapes_mesh wall;
  memset(&wall, 0, sizeof wall);
  shapes_box_at(&wall, -0.5, 0, 0, 1, 8, 1);
  robot_bare(&r, NSVCD_JOINT_REVOLUTE, 2, 2, 1);
  for (int j = 0; j < 2; j++) r.joints[j].axis[2] = 1;
  r.joints[1].origin.position[0] = 1;
  r.parts[0].body = body_of(&wall, NULL);
  r.parts[1].body = robot_shapes()[0].body;
  r.parts[1].scale = 0.01f;
  r.parts[1].link = 2;
  r.parts[1].pose.position[0] = 1;
  r.parts[0].pose.position[0] = 1.4f;
  robot_open(&r);
  for (int n = 0; n < 4; n++) {
    const double h = 0.05 * (n + 1);
    const double box[4] = {-h, -h, h, h};
    const double apart = parting_of(&r, pair, box, NULL, NULL);
    // of the arm's end, a cube of 1 mm
    const double truth = cos(h) + cos(2 * h) - 1.4;
    CHECK(apart <= truth && apart > truth - 0.002 - 2 * h * h * h);
  }
  free(r.memory);
  nsvcd_body_free(r.parts[0].body, NULL);
  shapes_free(&wall);
}

// Rounded bodies reach beyond their triangles, and a body with a hole encloses nothing for certain.
static void ranges_know_bodies(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  const float half[3] = {0.05f, 0.05f, 0.05f};
  shapes_mesh box;
  robot_bare(&r, NSVCD_JOINT_PRISMATIC, 1, 2, 300);
  r.joints[0].axis[1] = 1;
  CHECK_EQ(nsvcd_encode_box(half, 0.02f, NULL, &r.parts[0].body), NSVCD_OK);
  r.parts[1].body = r.parts[0].body;
  r.parts[1].link = 1;
  // one slides past the other; their triangles are 0.02 m inside of them
  for (int n = 0; n < 2; n++) {
    r.parts[1].pose.position[0] = n ? 0.101f : 0.099f;
    robot_open(&r);
    CHECK_EQ(range_of(&r, pair, 0, 0).meeting, n ? NSVCD_MEETS_NEVER : NSVCD_MEETS_SOMETIMES);
    free(r.memory);
  }
  nsvcd_body_free(r.parts[0].body, NULL);
  r.joints[0].low = -0.01;
  r.joints[0].high = 0.01;
  memset(&box, 0, sizeof box);
  shapes_box_at(&box, 0, 0, 0, 0.1, 0.1, 0.1);
  for (int n = 0; n < 2; n++) {
    box.triangles -= (size_t)n;
    r.parts[0].body = r.parts[1].body = body_of(&box, NULL);
    r.parts[1].pose.position[0] = 0.03f;
    robot_open(&r);
    const nsvcd_range_answer a = range_of(&r, pair, 0, 0);
    CHECK_EQ(a.meeting, n ? NSVCD_MEETS_UNKNOWN : NSVCD_MEETS_ALWAYS);
    CHECK_EQ(a.why, n ? NSVCD_WHY_OPEN : NSVCD_WHY_NOTHING);
    CHECK(a.has_hit && !a.has_free);
    nsvcd_body_free(r.parts[0].body, NULL);
    free(r.memory);
  }
  shapes_free(&box);
}

// Two boxes that slide past each other as near as the clearance, to the last bit: not proven.
static void ranges_too_near_to_tell(void) {
  static robot r;
  const nsvcd_body_pair pair = {0, 1};
  robot_bare(&r, NSVCD_JOINT_PRISMATIC, 1, 2, 0.01);
  r.joints[0].axis[1] = 1;
  for (int n = 0; n < 2; n++) r.parts[n].body = robot_shapes()[0].body;
  r.parts[1].link = 1;
  r.parts[1].pose.position[0] = 0.125f;
  robot_open(&r);
  const float gap = 0.125f - 2 * 0.05f;
  for (int n = 0; n < 8; n++) {
    const nsvcd_range_answer a = range_of(&r, pair, gap * (1 - 1e-7f * (float)n), 0);
    CHECK_EQ(a.meeting, NSVCD_MEETS_UNKNOWN);
    CHECK(a.why == NSVCD_WHY_TOO_NEAR && a.open > 0);
  }
  CHECK_EQ(range_of(&r, pair, 0.99f * gap, 0).meeting, NSVCD_MEETS_NEVER);
  free(r.memory);
}

static int stop_at_once(void *user) {
  (void)user;
  return 1;
}

static void ranges_refuse(void) {
  static robot r;
  static nsvcd_range_answer out;
  nsvcd_range_options o;
  const nsvcd_body_pair pair = {0, 1};
  const nsvcd_body_pair odd[3] = {{0, 0}, {0, 2}, {2, 0}};
  memset(&o, 0, sizeof o);
  robot_bare(&r, NSVCD_JOINT_REVOLUTE, 1, 2, 1);
  r.joints[0].axis[2] = 1;
  for (int n = 0; n < 2; n++) r.parts[n].body = robot_shapes()[0].body;
  r.parts[1].link = 1;
  robot_open(&r);
  const size_t size = nsvcd_pair_range_size(r.checker, pair, NULL);
  void *memory = malloc(size);
  for (int n = 0; n < 3; n++) {
    CHECK_EQ(nsvcd_pair_range_size(r.checker, odd[n], NULL), 0);
    CHECK_EQ(nsvcd_pair_range(r.checker, odd[n], NULL, memory, size, &out), NSVCD_ERROR_PAIR);
  }
  CHECK_EQ(nsvcd_pair_range_size(NULL, pair, NULL), 0);
  CHECK_EQ(nsvcd_pair_range(NULL, pair, NULL, memory, size, &out), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, NULL, memory, size, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, NULL, NULL, size, &out), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, NULL, memory, size - 1, &out), NSVCD_ERROR_WORKSPACE);
  o.clearance = -1;
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, &o, memory, size, &out), NSVCD_ERROR_CLEARANCE);
  o.clearance = 0;
  o.boxes = NSVCD_MAX_BOXES + 1;
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, &o, memory, size, &out), NSVCD_ERROR_COUNT);
  o.boxes = 0;
  o.stop = stop_at_once;
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, &o, memory, size, &out), NSVCD_OK);
  CHECK_EQ(out.meeting, NSVCD_MEETS_UNKNOWN);
  CHECK_EQ(out.why, NSVCD_WHY_WORK);
  o.stop = NULL;
  o.units = 1;
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, &o, memory, size, &out), NSVCD_OK);
  CHECK(out.meeting == NSVCD_MEETS_UNKNOWN && out.why == NSVCD_WHY_WORK);
  // about the centre of both they turn in each other
  CHECK_EQ(nsvcd_pair_range(r.checker, pair, NULL, memory, size, &out), NSVCD_OK);
  CHECK_EQ(out.meeting, NSVCD_MEETS_ALWAYS);
  free(memory);
  free(r.memory);
}

void test_ranges(void) {
  RUN(ranges_are_right);
  RUN(ranges_see_the_nearest);
  RUN(ranges_see_an_arm_straightened);
  RUN(ranges_see_a_hole);
  RUN(ranges_see_the_end_of_a_block);
  RUN(ranges_narrow);
  RUN(planes_part_no_less);
  RUN(planes_know_what_bends);
  RUN(ranges_know_bodies);
  RUN(ranges_too_near_to_tell);
  RUN(ranges_refuse);
}
CHECK_ALONE(test_ranges)
