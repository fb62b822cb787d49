// The motion of a body. The reference is double precision and written apart.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/motion/motion.h"

#include "check.h"
#include "random_motions.h"

void test_motion(void);

static void motion_pose_is_slerp(void) {
  double worst = 0;
  for (int trial = 0; trial < 300; trial++) {
    double middle[3] = {uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
    size_t count = pick(1, 40);
    nsvcd_pose fixed = {{1, -2, 0.5f}, {0, 0, 0, 1}};
    random_quat(fixed.rotation);
    random_motion(count, trial % 3, uniform(0, 12), 1, middle);
    nsvcd__motion motion;
    CHECK_EQ(motion_init(poses, count, &fixed, &motion), NSVCD_OK);
    nsvcd__motion_set_ticks(&motion, 64);
    for (int n = 0; n <= 10; n++) {
      const uint32_t tick = n == 10 ? motion.ticks : (uint32_t)pick(0, motion.ticks);
      const float point[3] = {0.3f, -0.2f, 0.9f};
      const double point64[3] = {(double)point[0], (double)point[1], (double)point[2]};
      double want[3];
      const oracle_pose at = pose_at(poses, count, (double)tick / (double)motion.ticks);
      oracle_transform(&at, point64, want);
      const nsvcd__world_pose found = nsvcd__track_pose(&motion.moving, tick);
      const nsvcd__mat3 turn = nsvcd__mat3_of(nsvcd__quat_unit(found.rotation));
      const nsvcd__f3 turned = nsvcd__mat3_apply(&turn, nsvcd__f3_load(point));
      const nsvcd__d3 out = nsvcd__d3_add(nsvcd__d3_widen(turned), found.position);
      worst = fmax(worst, fabs(out.x - want[0]));
      worst = fmax(worst, fabs(out.y - want[1]));
      worst = fmax(worst, fabs(out.z - want[2]));
    }
  }
  CHECK_LE(worst, 2e-6);
}

// Times of few bits are at ticks whatever the other body's count, and so are its poses.
static void times_are_at_ticks(void) {
  const nsvcd_pose good = {{0, 0, 0}, {0, 0, 0, 1}};
  static const float times[5] = {0, 1.0f / 65536, 0.375f, 1 - 1.0f / 1024, 1};
  for (size_t count = 1; count <= NSVCD_MAX_POSES; count += 1 + count / 3) {
    nsvcd_question question;
    nsvcd__motion motion;
    for (size_t n = 0; n < count; n++) poses[n] = good;
    memset(&question, 0, sizeof question);
    question.a.body = question.b.body = &any_body;
    question.a.poses = question.b.poses = poses;
    question.a.count = 5;
    question.a.times = times;
    question.b.count = count;
    nsvcd__motion_init(&question.a, &question.b, &motion);
    CHECK_GE(motion.ticks, 0x80000000u);
    for (uint32_t k = 0; k < 5; k++) {
      const double at = (double)times[k] * (double)motion.ticks;
      CHECK_LE(fabs((double)nsvcd__tick_of(&motion.moving, k) - at), 0);
      if (k < 4) CHECK_EQ(nsvcd__pose_before(&motion.moving, (uint32_t)at), k);
      if (k) CHECK_EQ(nsvcd__pose_before(&motion.moving, (uint32_t)at - 1), k - 1);
    }
    if (count > 1) {
      CHECK_EQ(nsvcd__tick_of(&motion.fixed, (uint32_t)count - 1), motion.ticks);
      CHECK_EQ(motion.ticks % (count - 1), 0);
    }
  }
}

void test_motion(void) {
  RUN(motion_pose_is_slerp);
  RUN(times_are_at_ticks);
}

CHECK_ALONE(test_motion)
