// A planar arm at the world's origin, of two links of 1 m that turn about z, beside a post: for the
// tests of what is promised of robots.
#ifndef NSVCD_TESTS_PROMISES_ARM_H
#define NSVCD_TESTS_PROMISES_ARM_H

#include "scene.h"

enum { ARM_JOINTS = 2, ARM_PARTS = 3, ARM_PAIRS = 2, UPPER = 0, FORE = 1, POST = 2 };

typedef struct arm {
  nsvcd_joint joints[ARM_JOINTS];
  nsvcd_part parts[ARM_PARTS];
  nsvcd_body_pair pairs[ARM_PAIRS];
  nsvcd_scene scene;
  const nsvcd_body *link, *post;
  nsvcd_checker *checker;
  void *memory;
} arm;

// Its links lie along x, 1.00 m long, 0.10 m wide; the post is 0.10 m wide.
static inline void arm_open(arm *a, nsvcd_pose post) {
  memset(a, 0, sizeof *a);
  a->link = box(1, 0.1f, 0.1f);
  a->post = box(0.1f, 0.1f, 2);
  for (uint32_t i = 0; i < ARM_JOINTS; i++) {
    a->joints[i] = (nsvcd_joint){.parent = i, .origin = at(i ? 1.1f : 0, 0, 0), .axis = {0, 0, 1}};
    a->joints[i].low = -3;
    a->joints[i].high = 3;
    a->parts[i] = (nsvcd_part){.body = a->link, .link = i + 1, .pose = at(0.55f, 0, 0)};
    a->pairs[i] = (nsvcd_body_pair){i, POST};
  }
  a->parts[POST] = (nsvcd_part){.body = a->post, .link = 0, .pose = post};
  a->scene = (nsvcd_scene){a->joints, ARM_JOINTS, a->parts, ARM_PARTS, a->pairs, ARM_PAIRS,
                           NULL,      NULL,       0,        NULL,      0};
  const size_t size = nsvcd_checker_size(&a->scene);
  a->memory = malloc(size);
  CHECK_EQ(nsvcd_checker_open(&a->scene, a->memory, size, &a->checker), NSVCD_OK);
}
static inline void arm_close(arm *a) {
  nsvcd_body_free(a->link, NULL);
  nsvcd_body_free(a->post, NULL);
  free(a->memory);
}

// Of one piece, from one configuration to another: four numbers.
static inline nsvcd_joint_motion line_of(const double *points) {
  const nsvcd_joint_motion motion = {.pieces = 1, .degree = 1, .points = points};
  return motion;
}

static inline nsvcd_check_answer check_of(const arm *a, const nsvcd_joint_motion *motion,
                                          float clearance) {
  const nsvcd_check_options options = {.clearance = clearance};
  nsvcd_check_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_check(a->checker, motion, &options, &answer), NSVCD_OK);
  return answer;
}
static inline nsvcd_verdict verdict_at(const arm *a, const double *joints) {
  const nsvcd_joint_motion still = {.degree = 1, .points = joints};
  return check_of(a, &still, 0).verdict;
}

#endif  // NSVCD_TESTS_PROMISES_ARM_H
