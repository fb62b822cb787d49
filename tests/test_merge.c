// test_merge.c - motions on clocks of their own, merged: as the motions say, at all times; two arms that
// meet or only miss each other by their clocks, as an oracle sees them in the separate motions.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "../examples/scenery/shapes.h"
#include "check.h"
#include "robot_scene.h"

void test_merge(void);

enum { MOST_MOTIONS = 5, MOST_OWN = 8, MOST_OWN_PIECES = 6 };

// Motions, and what they point to.
typedef struct motions {
  nsvcd_partial_motion list[MOST_MOTIONS];
  size_t count, joints;
  uint32_t indices[MOST_MOTIONS][MOST_OWN];
  double points[MOST_MOTIONS][(MOST_OWN_PIECES * NSVCD_MAX_DEGREE + 1) * MOST_OWN];
  double times[MOST_MOTIONS][MOST_OWN_PIECES + 1];
  double rest[NSVCD_MAX_JOINTS];
  void *memory;
  size_t size;
  nsvcd_joint_motion merged;
} motions;

static nsvcd_result merge(motions *m) {
  m->size = nsvcd_merge_motions_size(m->list, m->count, m->joints);
  free(m->memory);
  m->memory = malloc(m->size + 1);
  return nsvcd_merge_motions(m->list, m->count, m->joints, m->rest, m->memory, m->size, &m->merged);
}

static double knot(const nsvcd_partial_motion *m, size_t k) {
  return m->delay + (m->motion.times ? m->motion.times[k] : (double)k);
}

// Where column k of a motion is at a time, by Bernstein polynomials.
static double value_at(const nsvcd_partial_motion *m, size_t k, double time) {
  const nsvcd_joint_motion *own = &m->motion;
  size_t p = 0;
  if (own->pieces == 0 || time <= knot(m, 0)) return own->points[k];
  if (time >= knot(m, own->pieces))
    return own->points[own->pieces * own->degree * m->joint_count + k];
  while (time >= knot(m, p + 1)) p++;
  const double u = (time - knot(m, p)) / (knot(m, p + 1) - knot(m, p));
  double sum = 0;
  double choose = 1;
  for (size_t i = 0; i <= own->degree; i++) {
    const double weight = pow(u, (double)i) * pow(1 - u, (double)(own->degree - i));
    sum += choose * weight * own->points[(p * own->degree + i) * m->joint_count + k];
    choose *= (double)(own->degree - i) / (double)(i + 1);
  }
  return sum;
}

static void all_at(const motions *m, double time, double *q) {
  memcpy(q, m->rest, m->joints * sizeof *q);
  for (size_t n = 0; n < m->count; n++)
    for (size_t k = 0; k < m->list[n].joint_count; k++)
      q[m->list[n].joints[k]] = value_at(&m->list[n], k, time);
}

// Random motions of joints drawn without repeats, some of them without pieces; their times are often
// the same, or nearly.
static void random_motions(motions *m, shapes_rng *rng, size_t joints, double most) {
  uint32_t order[NSVCD_MAX_JOINTS];
  size_t used = 0;
  memset(m, 0, sizeof *m);
  m->joints = joints;
  for (size_t j = 0; j < joints; j++) order[j] = (uint32_t)j;
  for (size_t j = joints; j-- > 1;) {
    const size_t other = (size_t)shapes_pick(rng, (int)j + 1);
    const uint32_t was = order[j];
    order[j] = order[other];
    order[other] = was;
  }
  for (size_t j = 0; j < joints; j++) m->rest[j] = shapes_uniform(rng, -most, most);
  while (m->count < MOST_MOTIONS && used < joints) {
    nsvcd_partial_motion *one = &m->list[m->count];
    double *times = m->times[m->count];
    const size_t left = joints - used < MOST_OWN ? joints - used : MOST_OWN;
    one->joint_count = 1 + (size_t)shapes_pick(rng, (int)left);
    one->joints = m->indices[m->count];
    for (size_t k = 0; k < one->joint_count; k++) m->indices[m->count][k] = order[used++];
    one->motion.pieces = (size_t)shapes_pick(rng, MOST_OWN_PIECES + 1);
    one->motion.degree = 1 + (size_t)shapes_pick(rng, NSVCD_MAX_DEGREE);
    one->motion.points = m->points[m->count];
    const size_t rows = one->motion.pieces * one->motion.degree + 1;
    for (size_t i = 0; i < rows * one->joint_count; i++)
      m->points[m->count][i] = shapes_uniform(rng, -most, most);
    one->delay = shapes_pick(rng, 2) ? 0 : 0.1 * shapes_pick(rng, 30) - 1;
    double now = 0.1 * shapes_pick(rng, 10);
    for (size_t p = 0; p <= one->motion.pieces; p++) {
      times[p] = now;
      now += shapes_pick(rng, 2) ? 0.1 * (1 + shapes_pick(rng, 5)) : shapes_uniform(rng, 0.01, 1);
    }
    if (shapes_pick(rng, 3)) one->motion.times = times;
    m->count++;
  }
}

static void merged_motions_are_the_motions(void) {
  shapes_rng rng = {1};
  double worst = 0;
  for (size_t trial = 0; trial < check_many(400); trial++) {
    static motions m;
    double q[NSVCD_MAX_JOINTS], expected[NSVCD_MAX_JOINTS];
    random_motions(&m, &rng, 1 + (size_t)shapes_pick(&rng, 9), 3);
    CHECK_EQ(merge(&m), NSVCD_OK);
    const nsvcd_joint_motion *merged = &m.merged;
    size_t most = 0;
    size_t degree = 1;
    for (size_t n = 0; n < m.count; n++) {
      const nsvcd_joint_motion *own = &m.list[n].motion;
      most += own->pieces ? own->pieces + 1 : 0;
      if (own->pieces && own->degree > degree) degree = own->degree;
      // each knot is one of the whole
      for (size_t k = 0; own->pieces && k <= own->pieces; k++) {
        size_t same = 0;
        for (size_t p = 0; p <= merged->pieces; p++)
          same += fabs(merged->times[p] - knot(&m.list[n], k)) < 1e-10;
        CHECK_EQ(same, 1);
      }
    }
    CHECK_EQ(merged->degree, degree);
    CHECK_LE(merged->pieces, most);
    if (!merged->pieces) CHECK_EQ(most, 0);
    const double first = merged->pieces ? merged->times[0] : 0;
    const double last = merged->pieces ? merged->times[merged->pieces] : 0;
    for (size_t p = 0; p < merged->pieces; p++)
      CHECK(merged->times[p + 1] - merged->times[p] > 1e-12 * (last - first));
    for (int k = 0; k <= 300; k++) {
      const double time = first - 0.1 + (last - first + 0.2) * k / 300;
      nsvcd_motion_at(merged, m.joints, time, q);
      all_at(&m, time, expected);
      // times round too, and move a joint by its speed times that
      for (size_t j = 0; j < m.joints; j++) worst = fmax(worst, fabs(q[j] - expected[j]));
    }
    // what rests does so to the bit
    for (size_t j = 0; j < m.joints; j++) {
      int moves = 0;
      for (size_t n = 0; n < m.count; n++)
        for (size_t i = 0; i < m.list[n].joint_count; i++) moves |= m.list[n].joints[i] == j;
      for (size_t row = 0; row <= merged->pieces * merged->degree && !moves; row++)
        CHECK_EQ(merged->points[row * m.joints + j], m.rest[j]);
    }
    free(m.memory);
    m.memory = NULL;
  }
  CHECK_LE(worst, 2e-13);
}

// Boxes of 0.1 m that cross each other's way at right angles, at 1 m/s from 1 m off.
static void crossing_make(robot *r, motions *m) {
  static const double ways[2] = {-1, 1};
  static const uint32_t joints[2] = {0, 1};
  robot_bare(r, NSVCD_JOINT_PRISMATIC, 2, 2, 2);
  for (uint32_t n = 0; n < 2; n++) {
    r->joints[n].parent = 0;
    r->joints[n].axis[n] = 1;
    r->parts[n].body = robot_shapes()[0].body;
    r->parts[n].link = n + 1;
  }
  robot_open(r);
  memset(m, 0, sizeof *m);
  m->joints = m->count = 2;
  for (size_t n = 0; n < 2; n++) {
    static const double times[2] = {0, 2};
    const nsvcd_joint_motion line = {1, 1, ways, times};
    const nsvcd_partial_motion one = {line, &joints[n], 1, 0};
    m->list[n] = one;
  }
}

static nsvcd_check_answer first_conflict(const robot *r, motions *m, double to_time) {
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&options, 0, sizeof options);
  memset(&answer, 0, sizeof answer);
  options.to_time = to_time;
  CHECK_EQ(merge(m), NSVCD_OK);
  CHECK_EQ(nsvcd_check(r->checker, &m->merged, &options, &answer), NSVCD_OK);
  return answer;
}

// The time at which a hit is.
static double hit_time(const nsvcd_joint_motion *m, const nsvcd_check_answer *answer) {
  const double from = m->times[answer->piece];
  return from + answer->fraction * (m->times[answer->piece + 1] - from);
}

static void clocks_decide_who_meets(void) {
  static robot r;
  static motions m;
  crossing_make(&r, &m);
  nsvcd_check_answer answer = first_conflict(&r, &m, 1e-3);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_EQ(answer.pair, 0);
  CHECK(answer.free_until < 0.9 && answer.free_until > 0.899);
  CHECK_NEAR(hit_time(&m.merged, &answer), 0.9, 1.1e-3);
  // the first is past when the second comes, but for 1 mm
  m.list[1].delay = 0.199;
  answer = first_conflict(&r, &m, 1e-4);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_NEAR(hit_time(&m.merged, &answer), 1.099, 2e-4);
  CHECK_EQ(m.merged.pieces, 3);
  m.list[1].delay = 0.201;
  CHECK_EQ(first_conflict(&r, &m, 1e-3).verdict, NSVCD_FREE);
  // and the other way round
  m.list[1].delay = -0.201;
  CHECK_EQ(first_conflict(&r, &m, 1e-3).verdict, NSVCD_FREE);
  // they are 0.1 m apart while both are on their way, and then the second ends where the first rests
  m.list[1].delay = -5;
  answer = first_conflict(&r, &m, 1e-3);
  CHECK_EQ(answer.verdict, NSVCD_FREE);
  CHECK_EQ(answer.free_until, 2);
  free(m.memory);
  free(r.memory);
}

static void what_has_ended_rests(void) {
  static robot r;
  static motions m;
  static const double to_middle[2] = {-1, 0};
  crossing_make(&r, &m);
  m.list[0].motion.points = to_middle;
  m.list[1].delay = 50;
  // the first stands in the middle since t = 2
  nsvcd_check_answer answer = first_conflict(&r, &m, 1e-3);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_NEAR(hit_time(&m.merged, &answer), 50.9, 1.1e-3);
  CHECK(answer.free_until > 50.898);
  // it comes when the second has long stopped beside it: they touch, or nearly, at the very end
  static const double beside[2] = {-1, -0.1};
  m.list[1].delay = -50;
  m.list[1].motion.points = beside;
  answer = first_conflict(&r, &m, 1e-3);
  CHECK(answer.verdict != NSVCD_FREE);
  CHECK(answer.free_until > 1.7);
  static const double clear[2] = {-1, -0.1001};
  m.list[1].motion.points = clear;
  CHECK_EQ(first_conflict(&r, &m, 1e-3).verdict, NSVCD_FREE);
  static const double touching[2] = {-1, -0.0999};
  m.list[1].motion.points = touching;
  answer = first_conflict(&r, &m, 1e-3);
  CHECK_EQ(answer.verdict, NSVCD_HIT);
  CHECK_NEAR(hit_time(&m.merged, &answer), 1.8, 2e-3);
  free(m.memory);
  free(r.memory);
}

// Two arms of three joints that face each other, and an oracle on the separate motions.
static void two_arms_make(robot *r) {
  robot_bare(r, NSVCD_JOINT_REVOLUTE, 6, 6, 4);
  r->scene.pair_count = 0;
  for (uint32_t j = 0; j < 6; j++) {
    r->joints[j].axis[j % 3 == 0 ? 2 : 1] = 1;
    r->joints[j].parent = j % 3 ? j : 0;
    r->joints[j].origin.position[2] = j % 3 ? 0.35f : 0;
    r->joints[j].origin.position[0] = j == 3 ? 0.7f : 0;
    r->shape[j] = 1;
    r->parts[j].body = robot_shapes()[1].body;
    r->parts[j].link = j + 1;
    r->parts[j].pose.position[2] = 0.2f;
    for (uint32_t a = 0; a < 3 && j >= 3; a++) {
      const nsvcd_body_pair pair = {a, j};
      r->pairs[r->scene.pair_count++] = pair;
    }
  }
  robot_open(r);
}

static double arms_apart(const robot *r, const double *q) {
  double apart = 1;
  for (size_t n = 0; n < r->scene.pair_count; n++)
    apart = fmin(apart, robot_apart(r, &r->pairs[n], q, 0.01));
  return apart;
}

static void two_arms_meet_as_the_oracle_says(void) {
  static robot r;
  static motions m;
  shapes_rng rng = {5};
  size_t hits = 0;
  size_t frees = 0;
  two_arms_make(&r);
  for (size_t trial = 0; trial < check_many(200); trial++) {
    double q[NSVCD_MAX_JOINTS];
    random_motions(&m, &rng, 6, trial % 2 ? 0.6 : 1.5);
    const nsvcd_check_answer answer = first_conflict(&r, &m, 1e-3);
    const double first = m.merged.pieces ? m.merged.times[0] : 0;
    const double last = m.merged.pieces ? m.merged.times[m.merged.pieces] : 0;
    frees += answer.verdict == NSVCD_FREE;
    if (answer.verdict == NSVCD_FREE && m.merged.pieces) CHECK_EQ(answer.free_until, last);
    // nothing meets before free_until
    for (int k = 0; k < 200; k++) {
      const double time = first + (answer.free_until - first) * k / 200;
      if (answer.free_until <= first && answer.verdict != NSVCD_FREE) break;
      all_at(&m, time, q);
      CHECK(arms_apart(&r, q) > 0);
    }
    if (answer.verdict != NSVCD_HIT || !m.merged.pieces) continue;
    hits++;
    const double time = hit_time(&m.merged, &answer);
    CHECK(time <= answer.free_until + 1.1e-3);
    all_at(&m, time, q);
    CHECK_LE(robot_apart(&r, &r.pairs[answer.pair], q, 0.01), 1e-6);
    free(m.memory);
    m.memory = NULL;
  }
  CHECK(hits >= 40 && frees >= 40);
  free(m.memory);
  free(r.memory);
}

// The second motion is put back as it was.
static void refused(motions *m, const nsvcd_partial_motion *good, nsvcd_result code) {
  nsvcd_joint_motion out;
  CHECK_EQ(nsvcd_merge_motions_size(m->list, m->count, m->joints), 0);
  CHECK_EQ(nsvcd_merge_motions(m->list, m->count, m->joints, m->rest, m->memory, m->size, &out),
           code);
  m->list[1] = *good;
}

static void motions_are_refused_by_name(void) {
  static robot r;
  static motions m;
  const double none[2] = {0, 0};
  const double backwards[2] = {2, 1};
  const double long_after[2] = {3e12, 3e12 + 0.5};
  const double endless[2] = {0, HUGE_VAL};
  const double far_off[2] = {0, 1e13};
  nsvcd_joint_motion out;
  memset(&out, 0, sizeof out);
  crossing_make(&r, &m);
  const nsvcd_partial_motion good = m.list[1];
  nsvcd_partial_motion *one = &m.list[1];
  CHECK_EQ(merge(&m), NSVCD_OK);
  const uint32_t same = 0;
  const uint32_t beyond = 2;
  one->joints = &same;
  refused(&m, &good, NSVCD_ERROR_JOINT);
  one->joints = &beyond;
  refused(&m, &good, NSVCD_ERROR_JOINT);
  one->joints = NULL;
  refused(&m, &good, NSVCD_ERROR_ARGUMENT);
  one->motion.points = NULL;
  refused(&m, &good, NSVCD_ERROR_ARGUMENT);
  one->joint_count = 0;
  refused(&m, &good, NSVCD_ERROR_COUNT);
  one->joint_count = 3;
  refused(&m, &good, NSVCD_ERROR_COUNT);
  one->motion.degree = 0;
  refused(&m, &good, NSVCD_ERROR_DEGREE);
  one->motion.degree = 6;
  refused(&m, &good, NSVCD_ERROR_DEGREE);
  one->motion.points = endless;
  refused(&m, &good, NSVCD_ERROR_VALUE);
  one->motion.points = far_off;
  refused(&m, &good, NSVCD_ERROR_VALUE);
  one->motion.times = none;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  one->motion.times = backwards;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  one->motion.times = endless;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  one->motion.times = long_after;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  one->delay = HUGE_VAL;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  one->motion.pieces = SIZE_MAX / 2;
  refused(&m, &good, NSVCD_ERROR_DEGREE);
  // a piece that rounding makes short, or none
  const double short_one[2] = {0, 1e-13};
  one->motion.times = short_one;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  one->motion.times = short_one;
  one->delay = 1000;
  refused(&m, &good, NSVCD_ERROR_TIMES);
  m.joints = 0;
  refused(&m, &good, NSVCD_ERROR_COUNT);
  m.joints = NSVCD_MAX_JOINTS + 1;
  refused(&m, &good, NSVCD_ERROR_COUNT);
  m.joints = 2;
  CHECK_EQ(nsvcd_merge_motions(m.list, 2, 2, NULL, m.memory, m.size, &out), NSVCD_OK);
  CHECK_EQ(nsvcd_merge_motions(m.list, 1, 2, NULL, m.memory, m.size, &out), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_merge_motions(m.list, 1, 2, endless, m.memory, m.size, &out), NSVCD_ERROR_VALUE);
  CHECK_EQ(nsvcd_merge_motions(NULL, 1, 2, none, m.memory, m.size, &out), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_merge_motions(m.list, 2, 2, none, m.memory, m.size, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_merge_motions(m.list, 2, 2, none, m.memory, m.size - 1, &out),
           NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_merge_motions(m.list, 2, 2, none, NULL, m.size, &out), NSVCD_ERROR_WORKSPACE);
  // nobody moves
  CHECK_EQ(nsvcd_merge_motions(NULL, 0, 2, backwards, m.memory, m.size, &out), NSVCD_OK);
  CHECK_EQ(out.pieces, 0);
  CHECK(out.points[0] == 2 && out.points[1] == 1);
  free(m.memory);
  free(r.memory);
}

void test_merge(void) {
  RUN(merged_motions_are_the_motions);
  RUN(clocks_decide_who_meets);
  RUN(what_has_ended_rests);
  RUN(two_arms_meet_as_the_oracle_says);
  RUN(motions_are_refused_by_name);
}

CHECK_ALONE(test_merge)
