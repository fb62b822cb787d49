// The motion of one body as the other sees it. The reference is double precision and written apart.
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
    for (int n = 0; n <= 10; n++) {
      float t = n == 10 ? 1 : (float)uniform(0, 1);
      const float point[3] = {0.3f, -0.2f, 0.9f};
      const double point64[3] = {(double)point[0], (double)point[1], (double)point[2]};
      double want[3];
      pose64 at = pose_at(poses, count, (double)t);
      pose64 f = to_double(&fixed);
      place64(&at, &f, point64, want);
      const nsvcd__transform found = nsvcd__motion_pose(&motion, t);
      float out[3];
      nsvcd__f3_store(nsvcd__f3_transform(&found, nsvcd__f3_load(point)), out);
      for (int k = 0; k < 3; k++) worst = fmax(worst, fabs((double)out[k] - want[k]));
    }
  }
  CHECK_LE(worst, 3e-5);  // t itself is rounded: 40 samples of speed 6 between them, times 6e-8
}

static void bad_poses(void) {
  nsvcd_pose good = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd__motion motion;
  memset(&motion, 7, sizeof motion);
  nsvcd__motion before = motion;
  for (int n = 0; n < 5; n++) poses[n] = good;
  CHECK_EQ(motion_init(poses, 0, &good, &motion), NSVCD_ERROR_POSES);
  CHECK_EQ(motion_init(poses, (size_t)NSVCD_MAX_POSES + 1, &good, &motion), NSVCD_ERROR_POSES);
  CHECK_EQ(motion_init(NULL, 5, &good, &motion), NSVCD_ERROR_POSES);
  const float bad[6] = {(float)NAN, (float)INFINITY, -(float)INFINITY, 3e38f, 2e6f, 1e30f};
  for (int at = 0; at < 7; at++) {
    for (int n = 0; n < 6; n++) {
      nsvcd_pose evil = good;
      *(at < 3 ? &evil.position[at] : &evil.rotation[at - 3]) = bad[n];
      CHECK_EQ(motion_init(poses, 5, &evil, &motion),
               at < 3 ? NSVCD_ERROR_POSE : NSVCD_ERROR_QUATERNION);
      poses[4] = evil;
      CHECK_EQ(motion_init(poses, 5, &good, &motion),
               at < 3 ? NSVCD_ERROR_POSE : NSVCD_ERROR_QUATERNION);
      poses[4] = good;
    }
  }
  const float lengths[6] = {0, 0.9998f, 1.0002f, 0.99995f, 1.00005f, 1};
  for (int n = 0; n < 6; n++) {
    nsvcd_pose q = good;
    q.rotation[3] = lengths[n];
    nsvcd__motion m;
    CHECK_EQ(motion_init(&q, 1, &good, &m), n < 3 ? NSVCD_ERROR_QUATERNION : NSVCD_OK);
  }
  CHECK(memcmp(&motion, &before, sizeof motion) == 0);  // outputs untouched
}

static nsvcd_result times_check(const float *times, size_t count) {
  nsvcd_mover mover;
  memset(&mover, 0, sizeof mover);
  mover.body = &any_body;
  mover.poses = poses;
  mover.times = times;
  mover.count = count;
  return nsvcd__mover_check(&mover);
}

static void bad_times(void) {
  const nsvcd_pose good = {{0, 0, 0}, {0, 0, 0, 1}};
  const float rising[4] = {0, 1e-7f, 0.99999988f, 1};
  const float bad[9] = {
      (float)NAN, (float)INFINITY, -(float)INFINITY, -1e-7f, 2, 0.9e-7f, 0.5f, 1 - 5e-8f, 1};
  for (int n = 0; n < 4; n++) poses[n] = good;
  CHECK_EQ(times_check(rising, 4), NSVCD_OK);
  CHECK_EQ(times_check(NULL, 4), NSVCD_OK);
  CHECK_EQ(times_check(bad, 1), NSVCD_OK);  // one pose is there all the time
  for (int at = 0; at < 4; at++) {
    for (int n = 0; n < 9; n++) {
      float times[4];
      memcpy(times, rising, sizeof times);
      times[at] = bad[n];
      const int rises = (at == 3 && n == 8) || (at == 1 && n == 6) || (at == 2 && n == 6);
      CHECK_EQ(times_check(times, 4), rises ? NSVCD_OK : NSVCD_ERROR_TIMES);
    }
  }
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
  RUN(bad_poses);
  RUN(bad_times);
  RUN(times_are_at_ticks);
}

CHECK_ALONE(test_motion)
