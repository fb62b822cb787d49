// questions.h - how a mug and a dish rack move, in 32 ways. After neuralsvcd.h.
//
// The motions are the same on every machine, to the bit: they are made with integers, and with
// floats only by + * / and sqrtf. The compiler must not fuse * and +; gcc with -std=c99 does not.
#ifndef QUESTIONS_H
#define QUESTIONS_H

#define QUESTIONS 32
#define POSES 4    // the most of a motion
#define B_POSES 2  // the most of the rack's

// A random number in -1..1.
static float random_of(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)((int32_t)(*seed >> 16) - 32768) / 32768;
}

static nsvcd_pose pose_of(float x, float y, float z, float qx, float qy, float qz, float qw) {
  const float length = sqrtf(qx * qx + qy * qy + qz * qz + qw * qw);
  const nsvcd_pose pose = {{x, y, z}, {qx / length, qy / length, qz / length, qw / length}};
  return pose;
}
static nsvcd_pose upright(float x, float y, float z) {
  return pose_of(x, y, z, 0, 0, 0, 1);
}

// Somewhere in or around the rack, which is 0.4 m long, 0.3 m deep and 0.12 m high.
static nsvcd_pose random_pose(uint32_t *seed) {
  const float x = 0.30f * random_of(seed);
  const float y = 0.25f * random_of(seed);
  const float z = 0.15f + 0.15f * random_of(seed);
  const float qx = 0.5f * random_of(seed);
  const float qy = 0.5f * random_of(seed);
  const float qz = random_of(seed);
  return pose_of(x, y, z, qx, qy, qz, 1);
}

// Fills in how the mug, a, and the rack, b, move. poses: (POSES), b_poses: (B_POSES).
static void pose_question(uint32_t number, nsvcd_pose *poses, nsvcd_pose *b_poses,
                          nsvcd_question *question) {
  uint32_t seed = number * 2654435769u;
  const float step = (float)(number / 8);  // 0, 1, 2, 3
  question->a.poses = poses;
  question->a.count = 2;
  switch (number % 8) {
    case 0:  // along the front of the rack, 1.5 mm too near up to 1.5 mm off
    case 1:  // that path, while the mug turns about its axis
      poses[0] = upright(-0.3f, -0.1925f - 0.001f * step, 0.001f);
      poses[1] = upright(0.3f, -0.1925f - 0.001f * step, 0.001f);
      if (number % 8 == 1) poses[1] = pose_of(0.3f, -0.1925f - 0.001f * step, 0.001f, 0, 0, 1, 1);
      break;
    case 2:  // across its highest bars, 1.5 mm too low up to 1.5 mm off
      poses[0] = upright(-0.3f, 0.11f, 0.1197f + 0.001f * step);
      poses[1] = upright(0.3f, 0.12f, 0.1197f + 0.001f * step);
      break;
    case 3:  // let down into it
      poses[0] = random_pose(&seed);
      poses[0].position[2] = 0.3f;
      poses[1] = poses[0];
      poses[1].position[2] = 0.03f * step;
      break;
    case 4:  // a mug of 2 mm that stays within a bar of the rack, or goes on through its surface
      question->a.scale = 0.02f;
      poses[0] = upright(-0.1f, -0.15f, 0.002f);
      poses[1] = pose_of(0.1f, -0.15f + 0.002f * step, 0.002f, 0, 0, 1, 1);
      break;
    case 5:  // both move
      b_poses[0] = upright(0, 0, 0);
      b_poses[1] = pose_of(0, 0.1f, 0.1f, 0.2f, 0, 0, 1);
      question->b.poses = b_poses;
      question->b.count = 2;
      poses[0] = random_pose(&seed);
      poses[1] = random_pose(&seed);
      break;
    default:  // three or four poses anywhere, the more the higher
      question->a.count = 3 + number % 2;
      for (size_t i = 0; i < question->a.count; i++) {
        poses[i] = random_pose(&seed);
        poses[i].position[2] += 0.04f * step;
      }
  }
}
#endif
