// check_robots.c - random robots among random things move at random: is what nsvcd_check says so, at
// many times?
//
//   build/check_robots [ROBOTS] [SEED]
//
// ROBOTS trees of up to 8 joints of all kinds (200), six motions each: of degree 1 to 5, of up to 40
// pieces, with and without times and jumps of speed, with and without a clearance. FREE is looked at
// 151 times by distances in double, HIT in the configuration named. Ends with 1 if one is wrong.
#include "../test_robot.c"

check_state check;

#define PIECES 40
#define LOOKS 150

// The robot's bodies, things that rest about it, and about half of all pairs.
static void random_scene(robot *r, shapes_rng *rng) {
  robot_random(r, rng);
  const size_t moving = r->scene.part_count;
  for (size_t n = 0; n < moving; n++) r->parts[n].scale = 0;
  for (int n = 1 + shapes_pick(rng, 8); n > 0; n--) {
    const size_t part = r->scene.part_count++;
    r->shape[part] = shapes_pick(rng, SHAPES);
    memset(&r->parts[part], 0, sizeof r->parts[part]);
    r->parts[part].body = robot_shapes()[r->shape[part]].body;
    r->parts[part].pose = robot_pose(rng, shapes_uniform(rng, 0.1, 1.2));
  }
  for (uint32_t a = 0; a < moving; a++) {
    for (uint32_t b = a + 1; b < r->scene.part_count; b++) {
      if (b < moving && shapes_pick(rng, 2)) continue;
      const nsvcd_body_pair pair = {a, b};
      const nsvcd_body_pair turned = {b, a};
      r->pairs[r->scene.pair_count++] = shapes_pick(rng, 2) ? pair : turned;
    }
  }
}

// Points of a motion, (pieces degree + 1, joints). jumps: 0 of speed none, 1 small ones, 2 any.
static void random_motion(shapes_rng *rng, nsvcd_joint_motion *m, size_t joints, int jumps,
                          double *points, double *times) {
  const double size = pow(10, shapes_uniform(rng, -2.5, -0.2));
  times[0] = 0;
  for (size_t p = 0; p < m->pieces; p++) times[p + 1] = times[p] + pow(10, shapes_normal(rng) / 2);
  for (size_t j = 0; j < joints; j++) {
    double at = shapes_uniform(rng, -2, 2);
    for (size_t i = 0; i <= m->pieces * m->degree; i++) {
      double *x = &points[i * joints + j];
      *x = at;
      at += size / (double)m->degree * shapes_normal(rng);
      if (i < 2 || i % m->degree != 1 % m->degree || jumps == 2) continue;
      const size_t p = (i - 1) / m->degree;
      const double way = *(x - joints) - *(x - 2 * joints);
      *x = *(x - joints) + way * (times[p + 1] - times[p]) / (times[p] - times[p - 1]);
      if (jumps) *x += 1e-4 * shapes_normal(rng);
      if (fabs(*x) > 20) *x = 0;
      at = *x;
    }
  }
}

// Is a motion that is said to be free free at random times?
static int is_free(const robot *r, const nsvcd_joint_motion *m, shapes_rng *rng, double clearance) {
  const double end = m->times[m->pieces];
  for (int k = 0; k <= LOOKS; k++) {
    double q[NSVCD_MAX_JOINTS];
    const double off = k % LOOKS ? shapes_uniform(rng, -0.5, 0.5) : 0;
    joints_at_time(m, r->scene.joint_count, fmin(end * (k + off) / LOOKS, end), q);
    for (size_t p = 0; p < r->scene.pair_count; p++)
      if (robot_apart(r, &r->pairs[p], q, 0.1) + 1e-9 < clearance) return 0;
  }
  return 1;
}

int main(int count, char **values) {
  static robot r;
  static double points[(PIECES * NSVCD_MAX_DEGREE + 1) * NSVCD_MAX_JOINTS];
  const int robots = count > 1 ? atoi(values[1]) : 200;
  shapes_rng rng = {count > 2 ? 1000 + (uint64_t)atoi(values[2]) : 1000};
  size_t verdicts[3] = {0, 0, 0};
  size_t wrong = 0;
  for (int trial = 0; trial < robots; trial++) {
    random_scene(&r, &rng);
    robot_open(&r);
    for (int n = 0; n < 6; n++) {
      double times[PIECES + 1], told[PIECES + 1];
      nsvcd_check_options options;
      nsvcd_check_answer answer;
      memset(&options, 0, sizeof options);
      const size_t degree = 1 + (size_t)shapes_pick(&rng, NSVCD_MAX_DEGREE);
      const size_t pieces = 1 + (size_t)shapes_pick(&rng, n % 2 ? PIECES : 4);
      nsvcd_joint_motion motion = {pieces, degree, points, times};
      random_motion(&rng, &motion, r.scene.joint_count, shapes_pick(&rng, 3), points, times);
      if (!shapes_pick(&rng, 3)) motion.times = NULL;
      if (shapes_pick(&rng, 2)) options.clearance = (float)pow(10, shapes_uniform(&rng, -4, -1.5));
      if (nsvcd_check(r.checker, &motion, &options, &answer)) return 1;
      verdicts[answer.verdict]++;
      for (size_t p = 0; p <= pieces; p++) told[p] = motion.times ? times[p] : (double)p;
      const nsvcd_joint_motion timed = {pieces, degree, points, told};
      const double clearance = (double)options.clearance;
      int good = 1;
      if (answer.verdict == NSVCD_FREE) good = is_free(&r, &timed, &rng, clearance);
      if (answer.verdict == NSVCD_HIT) {
        double q[NSVCD_MAX_JOINTS];
        joints_of_piece(points + answer.piece * degree * r.scene.joint_count, degree,
                        r.scene.joint_count, answer.fraction, q);
        good = robot_apart(&r, &r.pairs[answer.pair], q, 0.1) <= clearance + 5e-5;
      }
      if (good) continue;
      wrong++;
      printf("wrong: robot %d, motion %d: said to be %s\n", trial, n,
             nsvcd_verdict_string(answer.verdict));
    }
    free(r.memory);
  }
  printf("%zu free, %zu hit, %zu undecided, %zu wrong\n", verdicts[NSVCD_FREE], verdicts[NSVCD_HIT],
         verdicts[NSVCD_UNDECIDED], wrong);
  return wrong > 0;
}
