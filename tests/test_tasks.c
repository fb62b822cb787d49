// The planning tasks of scenery/tasks.h: robots against closed formulas, episodes against what
// they promise, the judge against trajectories that are wrong in one way each.
#include "../examples/scenery/tasks.h"

#include "check.h"

void test_tasks(void);

static int tasks_make(task_scene *scene, int task, uint64_t seed) {
  return task == 0   ? task_dish_episode(scene, seed)
         : task == 1 ? task_bimanual_episode(scene, seed)
                     : task_mining_episode(scene, seed);
}

// ------------------------------------------------------------------------------------------ robots

// The product of the six Denavit-Hartenberg matrices, Rz(theta) Tz(d) Tx(a) Rx(alpha), row-major
// (3, 4).
static void tasks_ur5_formula(const double *q, double *out) {
  const double d[6] = {0.089159, 0, 0, 0.10915, 0.09465, 0.0823};
  const double a[6] = {0, -0.425, -0.39225, 0, 0, 0};
  const double alpha[6] = {TASK_PI / 2, 0, 0, TASK_PI / 2, -TASK_PI / 2, 0};
  double t[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  for (int i = 0; i < 6; i++) {
    double c = cos(q[i]);
    double s = sin(q[i]);
    double ca = cos(alpha[i]);
    double sa = sin(alpha[i]);
    double next[12];
    const double m[16] = {c, -s * ca, s * sa, a[i] * c, s, c * ca, -c * sa, a[i] * s,
                          0, sa,      ca,     d[i],     0, 0,      0,       1};
    for (int r = 0; r < 3; r++)
      for (int k = 0; k < 4; k++) {
        next[4 * r + k] = 0;
        for (int j = 0; j < 4; j++) next[4 * r + k] += t[4 * r + j] * m[4 * j + k];
      }
    memcpy(t, next, sizeof t);
  }
  memcpy(out, t, sizeof t);
}
static void tasks_ur5_is_where_the_formula_says(void) {
  static task_scene scene;
  double q[TASK_MAX_JOINTS] = {0};
  double expected[12];
  double m[9];
  double flange[3];
  const double tool[3] = {0, 0, 0.0823};
  oracle_pose links[TASK_MAX_JOINTS + 1];
  task_begin(&scene, "", 5);
  task_add_ur5(&scene, 0);
  for (int n = 0; n < 200; n++) {
    if (n) task_random_joints(&scene, NULL, 0, q);
    tasks_ur5_formula(q, expected);
    task_links(&scene, q, links);
    oracle_transform(&links[6], tool, flange);
    oracle_matrix(links[6].rotation, m);
    for (int i = 0; i < 3; i++) {
      CHECK_NEAR(flange[i], expected[4 * i + 3], 1e-12);
      for (int k = 0; k < 3; k++) CHECK_NEAR(m[3 * i + k], expected[4 * i + k], 1e-12);
    }
    if (n) continue;  // at zero, the numbers that every user of a UR5 knows
    CHECK_NEAR(flange[0], -0.81725, 1e-9);
    CHECK_NEAR(flange[1], -0.19145, 1e-9);
    CHECK_NEAR(flange[2], -0.005491, 1e-9);
  }
  task_free(&scene);
}
static void tasks_armada_is_symmetric(void) {
  static task_scene scene;
  task_begin(&scene, "", 6);
  task_add_armada_arm(&scene, 0);
  task_add_armada_arm(&scene, 1);
  for (int n = 0; n < 100; n++) {
    double q[TASK_MAX_JOINTS], left[3], right[3];
    oracle_pose links[TASK_MAX_JOINTS + 1];
    const double tool[2][3] = {{0.021, 0.07, -0.0165}, {-0.021, 0.07, -0.0165}};
    task_random_joints(&scene, NULL, 0, q);
    for (int j = 0; j < 6; j++) q[6 + j] = -q[j];
    CHECK(task_in_limits(&scene, q));
    task_links(&scene, q, links);
    oracle_transform(&links[6], tool[0], left);
    oracle_transform(&links[12], tool[1], right);
    for (int k = 0; k < 3; k++) CHECK_NEAR(left[k], k == 1 ? -right[k] : right[k], 1e-12);
  }
  task_free(&scene);
}
// From nearby joints, inverse kinematics finds back to a pose that is known to exist.
static void tasks_inverse_kinematics(void) {
  static task_scene scene;
  int solved = 0;
  task_begin(&scene, "", 7);
  task_add_ur5(&scene, 0);
  for (int n = 0; n < 100; n++) {
    double truth[TASK_MAX_JOINTS], q[TASK_MAX_JOINTS], error[6], nominal[6];
    oracle_pose links[TASK_MAX_JOINTS + 1], target;
    task_ur5_down(0.3, 0, nominal);
    task_random_joints(&scene, nominal, 0.3, truth);
    task_links(&scene, truth, links);
    target = task_body_pose(&scene, 5, links);
    task_random_joints(&scene, nominal, 0.3, q);
    if (!task_ik(&scene, q, 5, -1, &target)) continue;
    solved++;
    CHECK(task_in_limits(&scene, q));
    task_error(&scene, q, 5, -1, &target, error);
    CHECK_LE(oracle_length(error), 1e-6);
    CHECK_LE(oracle_length(error + 3), 1e-6);
  }
  CHECK_GE(solved, 95);
  task_free(&scene);
}

// ---------------------------------------------------------------------------------------- episodes

static void tasks_repeat_from_their_seed(void) {
  for (int task = 0; task < 3; task++) {
    static task_scene a, b, other;
    CHECK(tasks_make(&a, task, 12) && tasks_make(&b, task, 12) && tasks_make(&other, task, 13));
    CHECK_EQ(memcmp(a.problems, b.problems, sizeof a.problems), 0);
    CHECK_EQ(memcmp(a.settled, b.settled, sizeof a.settled), 0);
    CHECK_EQ(memcmp(a.pairs, b.pairs, sizeof a.pairs), 0);
    CHECK(memcmp(a.problems, other.problems, sizeof a.problems));
    task_free(&a);
    task_free(&b);
    task_free(&other);
  }
}
static void tasks_bodies_are_closed(void) {
  for (int task = 0; task < 3; task++)
    for (uint64_t seed = 0; seed < 6; seed++) {
      static task_scene scene;
      CHECK(tasks_make(&scene, task, seed));
      for (int i = 0; i < scene.body_count; i++) {
        const nsvcd_mesh *mesh = &scene.bodies[i].mesh;
        double *positions = (double *)malloc(3 * mesh->vertex_count * sizeof *positions);
        for (size_t k = 0; k < 3 * mesh->vertex_count; k++)
          positions[k] = (double)mesh->positions[k];
        int closed =
            oracle_is_closed(positions, mesh->vertex_count, mesh->indices, mesh->triangle_count);
        if (!closed) printf("%s: not closed\n", scene.bodies[i].name);
        CHECK(closed);
        double volume = 0;  // positive: wound outwards
        for (size_t k = 0; k < scene.bodies[i].exact.triangle_count; k++) {
          const oracle_triangle *t = &scene.bodies[i].exact.triangles[k];
          double cross[3];
          oracle_cross(t->v[1], t->v[2], cross);
          volume += oracle_dot(t->v[0], cross) / 6;
        }
        CHECK(volume > 0);
        free(positions);
      }
      task_free(&scene);
    }
}
static void tasks_starts_and_goals_are_free(void) {
  for (int task = 0; task < 3; task++)
    for (uint64_t seed = 20; seed < 28; seed++) {
      static task_scene scene;
      CHECK(tasks_make(&scene, task, seed));
      for (int i = 0; i < scene.problem_count; i++) {
        const float *ends[3] = {scene.problems[i].start, scene.problems[i].goal,
                                scene.problems[i].approach};
        task_select(&scene, i);
        CHECK(scene.pair_count > 0);
        for (int end = 0; end < 3; end++) {
          double q[TASK_MAX_JOINTS];
          for (int j = 0; j < scene.joint_count; j++) q[j] = (double)ends[end][j];
          CHECK(task_configuration_free(&scene, q, end == 2 ? TASK_CLEAR / 2 : TASK_CLEAR));
        }
      }
      task_free(&scene);
    }
}
// Every dish rests on the rack once it is in: 1 mm lower, it touches; and no settled dishes touch.
// Its goal is above.
static void tasks_dishes_settle(void) {
  for (uint64_t seed = 30; seed < 38; seed++) {
    static task_scene scene;
    CHECK(task_dish_episode(&scene, seed));
    int rack = 0;
    while (strcmp(scene.bodies[rack].name, "rack")) rack++;
    for (int i = 0; i < 3; i++) {
      const oracle_mesh *dish = &scene.bodies[scene.held[i]].exact;
      oracle_pose lower = scene.settled[i];
      oracle_pose links[TASK_MAX_JOINTS + 1];
      lower.position[2] -= 0.001;
      const oracle_pose *rack_pose = &scene.bodies[rack].offset;
      CHECK(oracle_distance(dish, &scene.settled[i], &scene.bodies[rack].exact, rack_pose, NULL,
                            NULL) > 0);
      CHECK_LE(oracle_distance(dish, &scene.settled[i], &scene.bodies[rack].exact, rack_pose, NULL,
                               NULL),
               1e-4);
      CHECK_EQ(oracle_distance(dish, &lower, &scene.bodies[rack].exact, rack_pose, NULL, NULL), 0);
      for (int k = 0; k < i; k++)
        CHECK(oracle_distance(dish, &scene.settled[i], &scene.bodies[scene.held[k]].exact,
                              &scene.settled[k], NULL, NULL) > 0.01);
      double q[TASK_MAX_JOINTS];
      task_select(&scene, i);
      for (int j = 0; j < scene.joint_count; j++) q[j] = (double)scene.problems[i].goal[j];
      task_links(&scene, q, links);
      oracle_pose held = task_body_pose(&scene, scene.held[i], links);
      for (int k = 0; k < 3; k++)
        CHECK_NEAR(held.position[k], scene.settled[i].position[k] + (k == 2 ? 0.01 : 0), 1e-5);
    }
    task_free(&scene);
  }
}
// A dish is absent, then in the hand, then in the rack; only the one in the hand moves, and absent
// ones have no pairs.
static void tasks_attach_and_release(void) {
  static task_scene scene;
  static nsvcd_pose at_start[TASK_MAX_BODIES], at_goal[TASK_MAX_BODIES];
  CHECK(task_dish_episode(&scene, 4));
  for (int round = 0; round < 4; round++) {  // there and back again
    int selected = round < 3 ? round : 0;
    task_select(&scene, selected);
    task_place(&scene, scene.problems[selected].start, at_start);
    task_place(&scene, scene.problems[selected].goal, at_goal);
    for (int i = 0; i < 3; i++) {
      int body = scene.held[i];
      int pairs = 0;
      for (int k = 0; k < scene.pair_count; k++)
        pairs += scene.pairs[k][0] == body || scene.pairs[k][1] == body;
      CHECK_EQ(pairs > 0, i <= selected);
      CHECK_EQ(memcmp(&at_start[body], &at_goal[body], sizeof at_goal[0]) != 0, i == selected);
      if (i < selected) CHECK_NEAR(at_goal[body].position[2], scene.settled[i].position[2], 1e-6);
    }
  }
  task_free(&scene);
}

// ------------------------------------------------------------------------------------------- judge

// Standing at the goal succeeds; what is wrong with the others is known.
static void tasks_judge(void) {
  for (int task = 0; task < 3; task++) {
    static task_scene scene;
    static float path[21 * TASK_MAX_JOINTS];
    task_verdict verdict;
    CHECK(tasks_make(&scene, task, 2));
    const int n = scene.joint_count;
    task_problem *problem = &scene.problems[0];
    memcpy(problem->start, problem->goal, sizeof problem->goal);
    for (int s = 0; s < 21; s++)
      for (int j = 0; j < n; j++) path[s * n + j] = problem->goal[j];
    CHECK(task_check(&scene, path, 21, &verdict));
    CHECK(verdict.free && verdict.in_limits && verdict.at_goal);
    CHECK(task_check(&scene, path, 1, NULL));

    path[20 * n] += 0.01f;  // 10 times what counts as the goal
    CHECK(!task_check(&scene, path, 21, &verdict) && !verdict.at_goal);
    path[20 * n] = problem->goal[0];

    double limit = scene.joints[n - 1].high;
    scene.joints[n - 1].high = (double)problem->goal[n - 1] - 0.1;
    CHECK(!task_check(&scene, path, 21, &verdict) && !verdict.in_limits);
    scene.joints[n - 1].high = limit;

    // Into something for one sample between free ones: a joint turns until something is hit.
    double q[TASK_MAX_JOINTS];
    double hit = 0;
    for (int j = 0; j < n; j++) q[j] = (double)problem->goal[j];
    int joint = task == 2 ? 0 : task == 1 ? 5 : 1;
    for (; hit < 1.5 && task_configuration_free(&scene, q, 0); hit += 0.02)
      q[joint] += task == 1 ? -0.02 : 0.02;
    CHECK(hit < 1.5);
    path[10 * n + joint] = (float)q[joint];
    CHECK(!task_check(&scene, path, 21, &verdict) && !verdict.free && verdict.at_goal);
    CHECK_NEAR(verdict.time, 0.5, 0.051);
    CHECK(verdict.pair[0] != verdict.pair[1]);
    task_free(&scene);
  }
}
// Against brute force: the judge's verdict on straight lines is that of distances at many poses.
static void tasks_judge_agrees_with_distances(void) {
  int collisions = 0;
  int problems = 0;
  for (int task = 0; task < 3; task++)
    for (uint64_t seed = 40; seed < 44; seed++) {
      static task_scene scene;
      double line[2 * TASK_MAX_JOINTS];
      double least = HUGE_VAL;
      CHECK(tasks_make(&scene, task, seed));
      const int n = scene.joint_count;
      const int steps = 60;
      for (int j = 0; j < n; j++) {  // the last stretch: near the goal, where the verdict is hard
        line[n + j] = (double)scene.problems[0].goal[j];
        line[j] = 0.9 * line[n + j] + 0.1 * (double)scene.problems[0].start[j];
      }
      for (int s = 0; s <= steps && least > 0; s++) {
        double q[TASK_MAX_JOINTS];
        oracle_pose links[TASK_MAX_JOINTS + 1];
        for (int j = 0; j < n; j++) q[j] = line[j] + (line[n + j] - line[j]) * s / steps;
        task_links(&scene, q, links);
        for (int p = 0; p < scene.pair_count && least > 0; p++) {
          int a = scene.pairs[p][0];
          int b = scene.pairs[p][1];
          oracle_pose pose_a = task_body_pose(&scene, a, links);
          oracle_pose pose_b = task_body_pose(&scene, b, links);
          double d = oracle_distance(&scene.bodies[a].exact, &pose_a, &scene.bodies[b].exact,
                                     &pose_b, NULL, NULL);
          least = fmin(least, d);
        }
      }
      int free_line = task_keeps(&scene, line, 2, 0, NULL);
      if (least <= 0) CHECK(!free_line);      // a collision that sampling sees, the judge sees
      if (!free_line) CHECK_LE(least, 0.02);  // and none where nothing is near
      collisions += !free_line;
      problems++;
      task_free(&scene);
    }
  CHECK(collisions > 0 && collisions < problems);
}

void test_tasks(void) {
  RUN(tasks_ur5_is_where_the_formula_says);
  RUN(tasks_armada_is_symmetric);
  RUN(tasks_inverse_kinematics);
  RUN(tasks_repeat_from_their_seed);
  RUN(tasks_bodies_are_closed);
  RUN(tasks_starts_and_goals_are_free);
  RUN(tasks_dishes_settle);
  RUN(tasks_attach_and_release);
  RUN(tasks_judge);
  RUN(tasks_judge_agrees_with_distances);
}

CHECK_ALONE(test_tasks)
