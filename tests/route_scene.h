// route_scene.h - routes of the arm of robot_scene.h: asked, and looked at by their points. Include what
// that needs, and the header of robots, before it.
#ifndef NSVCD_TESTS_ROUTE_SCENE_H
#define NSVCD_TESTS_ROUTE_SCENE_H

#include "robot_scene.h"

// Where a motion is at a time.
static void joints_at_time(const nsvcd_joint_motion *motion, size_t joints, double t, double *out) {
  size_t p = 0;
  while (p + 1 < motion->pieces && motion->times[p + 1] <= t) p++;
  const double fraction = (t - motion->times[p]) / (motion->times[p + 1] - motion->times[p]);
  joints_of_piece(motion->points + p * motion->degree * joints, motion->degree, joints, fraction,
                  out);
}

// A motion keeps the limits, has no jumps of speed, and is at rest at both ends; all by its points.
static void robot_motion_is_smooth(const robot *r, const nsvcd_joint_motion *m, const double *start,
                                   const double *goal) {
  const size_t joints = r->scene.joint_count;
  CHECK_EQ(m->degree, 2);
  CHECK_EQ(m->times[0], 0);
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &r->joints[j];
    double last = 0;
    CHECK_EQ(m->points[j], start[j]);
    CHECK_NEAR(m->points[2 * m->pieces * joints + j], goal[j], 1e-12);
    for (size_t p = 0; p < m->pieces; p++) {
      const double *at = m->points + 2 * p * joints + j;
      const double time = m->times[p + 1] - m->times[p];
      const double v0 = 2 * (at[joints] - at[0]) / time;
      const double v1 = 2 * (at[2 * joints] - at[joints]) / time;
      CHECK_NEAR(v0, last, 1e-7);
      CHECK_LE(fabs(v1), joint->speed);
      CHECK_LE(fabs(v1 - v0) / time, joint->acceleration);
      last = v1;
    }
    CHECK_NEAR(last, 0, 1e-7);
  }
}

// A configuration of an arm among boxes that is free by so much.
static int robot_free_place(robot *r, shapes_rng *rng, float clearance, double *q) {
  const nsvcd_joint_motion still = {0, 0, q, NULL};
  nsvcd_check_options options;
  nsvcd_check_answer answer;
  memset(&options, 0, sizeof options);
  options.clearance = clearance;
  for (int n = 0; n < 200; n++) {
    for (size_t j = 0; j < 6; j++) q[j] = shapes_uniform(rng, -3.1, 3.1);
    CHECK_EQ(nsvcd_check(r->checker, &still, &options, &answer), NSVCD_OK);
    if (answer.verdict == NSVCD_FREE) return 1;
  }
  return 0;
}

// Ends a search after so many calls: user is an int.
static inline int robot_stop(void *user) {
  return --*(int *)user < 0;
}

typedef struct asked_route {
  nsvcd_route_problem problem;
  nsvcd_route_options options;
  nsvcd_route_answer answer;
  double start[6], goals[3][6];
  void *memory;
  size_t size;
} asked_route;

static void ask_route(robot *r, asked_route *a) {
  a->problem.start = a->start;
  a->problem.goals = &a->goals[0][0];
  if (!a->problem.goal_count) a->problem.goal_count = 1;
  a->size = nsvcd_route_size(r->checker, &a->problem, &a->options);
  free(a->memory);
  a->memory = calloc(1, a->size);
  if (!a->size || !a->memory) exit(1);
  CHECK_EQ(nsvcd_route(r->checker, &a->problem, &a->options, a->memory, a->size, &a->answer),
           NSVCD_OK);
}

#endif
