// Round bodies: spheres, capsules, round boxes, clouds and triangles with a thickness, against
// distances of their skeletons in double, by all pairs. The Makefile compiles this file as it does
// test_asks.c.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../neuralsvcd.h"

#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "question_of.h"
#include "check.h"

void test_round(void);

// A body and its skeleton. half: of a box, the skeleton's, where the inside counts; else 0.
typedef struct round_body {
  const nsvcd_body *body;
  double round, reach, half[3];
  oracle_triangle *parts;
  size_t count;
} round_body;

// An answer, and the same again, whatever the workspace held.
static nsvcd_answer round_ask(const nsvcd_question *question) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(512, 512, 64));
  nsvcd_answer answers[2];
  for (int n = 0; n < 2; n++) {
    memset(workspace, n ? 0x41 : 0, sizeof workspace);
    memset(&answers[n], 0, sizeof answers[n]);
    CHECK_EQ(nsvcd_sweep(question, workspace, sizeof workspace, &answers[n]), NSVCD_OK);
  }
  CHECK_EQ(answers[0].work, answers[1].work);
  CHECK_EQ(answers[0].time.low, answers[1].time.low);
  CHECK_EQ(memcmp(answers[0].nearest.point, answers[1].nearest.point, 12), 0);
  return answers[0];
}

// ------------------------------------------------------------------------------------------ bodies

static void round_parts(round_body *b, const float *positions, const uint32_t *corners,
                        size_t count) {
  b->count = count;
  b->parts = (oracle_triangle *)calloc(count, sizeof *b->parts);
  if (!b->parts) exit(1);
  for (size_t i = 0; i < 9 * count; i++) {
    const double x = (double)positions[3 * corners[i / 3] + i % 3];
    b->parts[i / 9].v[i / 3 % 3][i % 3] = x;
  }
  for (size_t i = 0; i < count; i++) {
    oracle_triangle_normal(&b->parts[i]);
    for (int k = 0; k < 3; k++) b->reach = fmax(b->reach, oracle_length(b->parts[i].v[k]));
  }
  b->reach += b->round;
}

#define KINDS 5
static round_body round_make(shapes_rng *rng, int kind) {
  round_body out;
  float p[3 * 40];
  uint32_t corners[3 * 40];
  nsvcd_result result = NSVCD_OK;
  memset(&out, 0, sizeof out);
  for (size_t i = 0; i < 120; i++) {
    p[i] = (float)shapes_uniform(rng, -0.1, 0.1);
    corners[i] = (uint32_t)(i / 3);
  }
  const float round = (float)pow(10, shapes_uniform(rng, -3, -0.7));
  out.round = (double)round;
  if (kind == 0) {
    memset(p, 0, 3 * sizeof *p);
    result = nsvcd_encode_sphere(round, NULL, &out.body);
    round_parts(&out, p, corners, 1);
  } else if (kind == 1) {
    const uint32_t segment[3] = {0, 1, 1};
    result = nsvcd_encode_capsule(p, p + 3, round, NULL, &out.body);
    round_parts(&out, p, segment, 1);
  } else if (kind == 2) {
    const uint32_t faces[36] = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    float half[3];
    for (int k = 0; k < 3; k++) {
      half[k] = round + (float)shapes_uniform(rng, 0.001, 0.1);
      out.half[k] = (double)(half[k] - round);
      for (int n = 0; n < 8; n++) p[3 * n + k] = n >> k & 1 ? half[k] - round : round - half[k];
    }
    result = nsvcd_encode_box(half, round, NULL, &out.body);
    round_parts(&out, p, faces, 12);
  } else if (kind == 3) {
    const size_t count = 1 + (size_t)shapes_pick(rng, 40);
    result = nsvcd_encode_cloud(p, count, round, NULL, &out.body);
    for (size_t i = 0; i < 120; i++) corners[i] = (uint32_t)(i / 3);
    round_parts(&out, p, corners, count);
  } else {
    // some triangles, and some that are segments
    const nsvcd_encode_options options = {.convex_radius = round};
    nsvcd_mesh mesh = {p, corners, 40, 5};
    for (uint32_t i = 0; i < 15; i++) corners[i] = i % 6 == 5 ? i - 1 : i;
    result = nsvcd_encode(&mesh, &options, NULL, NULL, 0, &out.body);
    round_parts(&out, p, corners, 5);
  }
  CHECK_EQ(result, NSVCD_OK);
  const nsvcd_body_facts facts = nsvcd_body_describe(out.body);
  CHECK_EQ(facts.convex_radius, round);
  CHECK_LE(facts.radius, out.reach * 2 + 1e-6);
  return out;
}

static void round_free(round_body *b) {
  nsvcd_body_free(b->body, NULL);
  free(b->parts);
}

// ---------------------------------------------------------------------------------------- distances

static void round_place(const round_body *b, const oracle_pose *pose, double scale,
                        oracle_triangle *out) {
  for (size_t i = 0; i < b->count; i++) {
    for (int k = 0; k < 3; k++) {
      double v[3];
      for (int n = 0; n < 3; n++) v[n] = scale * b->parts[i].v[k][n];
      oracle_transform(pose, v, out[i].v[k]);
    }
    oracle_triangle_normal(&out[i]);
  }
}

// Is some corner within the core of a box?
static int round_holds(const round_body *box, const oracle_pose *pose, double scale,
                       const oracle_triangle *parts, size_t count) {
  double m[9];
  oracle_matrix(pose->rotation, m);
  for (size_t i = 0; i < 3 * count && box->half[0] > 0; i++) {
    double d[3], x[3];
    oracle_sub(parts[i / 3].v[i % 3], pose->position, d);
    oracle_rotate_back(m, d, x);
    int within = 1;
    for (int k = 0; k < 3; k++) within = within && fabs(x[k]) < scale * box->half[k];
    if (within) return 1;
  }
  return 0;
}

// Of the two at a time: how far apart, less than 0 where they overlap.
static double round_apart(const nsvcd_question *q, const round_body *a, const round_body *b,
                          double t) {
  oracle_pose poses[2][2], at[2];
  oracle_triangle parts[2][40];
  double best = DBL_MAX;
  double x[3], y[3];
  const nsvcd_mover *movers[2] = {&q->a, &q->b};
  const round_body *bodies[2] = {a, b};
  for (int n = 0; n < 2; n++) {
    for (size_t k = 0; k < movers[n]->count; k++) poses[n][k] = pose_widened(&movers[n]->poses[k]);
    at[n] = oracle_pose_at(poses[n], movers[n]->count, t);
    round_place(bodies[n], &at[n], (double)movers[n]->scale, parts[n]);
  }
  for (size_t i = 0; i < a->count; i++) {
    for (size_t j = 0; j < b->count; j++)
      best = fmin(best, oracle_triangles(&parts[0][i], &parts[1][j], DBL_MAX, x, y));
  }
  if (round_holds(a, &at[0], (double)q->a.scale, parts[1], b->count) ||
      round_holds(b, &at[1], (double)q->b.scale, parts[0], a->count))
    best = 0;
  return sqrt(best) - (double)q->a.scale * a->round - (double)q->b.scale * b->round;
}

// How far a place is from a body's surface at a time; less than 0 within it.
static double round_depth(const nsvcd_mover *m, const round_body *b, const float *place, double t) {
  oracle_pose poses[2];
  oracle_triangle parts[40], point;
  double best = DBL_MAX;
  double x[3], y[3];
  memset(&point, 0, sizeof point);
  for (int i = 0; i < 9; i++) point.v[i / 3][i % 3] = (double)place[i % 3];
  for (size_t k = 0; k < m->count; k++) poses[k] = pose_widened(&m->poses[k]);
  const oracle_pose at = oracle_pose_at(poses, m->count, t);
  round_place(b, &at, (double)m->scale, parts);
  for (size_t i = 0; i < b->count; i++)
    best = fmin(best, oracle_triangles(&parts[i], &point, DBL_MAX, x, y));
  return sqrt(best) - (double)m->scale * b->round;
}

// ------------------------------------------------------------------------------------------- tests

typedef struct round_sum {
  size_t free, hits, firsts, undecided, inside;
  double widest;
} round_sum;

static void round_judge(const nsvcd_question *q, const round_body *a, const round_body *b,
                        round_sum *sum) {
  const nsvcd_answer answer = round_ask(q);
  const double clearance = (double)q->clearance;
  const double quanta =
      (double)q->a.scale * (double)nsvcd_body_describe(a->body).quantization_error +
      (double)q->b.scale * (double)nsvcd_body_describe(b->body).quantization_error;
  const double reach = (double)q->a.scale * a->reach + (double)q->b.scale * b->reach;
  const double off = 1e-6 * (reach + 1) + 2 * quanta;
  double least = DBL_MAX;
  const int is_first = q->ask == NSVCD_ASK_FIRST;
  for (int k = 0; k <= 200; k++) {
    const double t = k / 200.0;
    const double apart = round_apart(q, a, b, t);
    if (t > (double)answer.time.high) break;
    least = fmin(least, apart);
    if (answer.verdict == NSVCD_FREE || (is_first && t < (double)answer.time.low))
      CHECK_LE(clearance - off, apart);
  }
  if (answer.verdict == NSVCD_HIT) {
    const double t = (double)answer.time.high;
    const double apart = round_apart(q, a, b, t);
    CHECK_LE(apart, clearance + off);
    least = fmin(least, apart);
    if (!answer.inside && apart > off) {
      const nsvcd_contact *c = &answer.nearest;
      const double on_b = round_depth(&q->b, b, c->point, t);
      const double to_a = round_depth(&q->a, a, c->point, t);
      float moved[3];
      for (int k = 0; k < 3; k++) moved[k] = c->point[k] + c->gap * c->normal[k];
      const double on_a = round_depth(&q->a, a, moved, t);
      // another two of their parts may be nearer
      CHECK_LE(apart - off, (double)c->gap);
      CHECK_LE((double)c->gap, clearance + off);
      CHECK_LE(on_b, off);
      CHECK_LE(to_a, (double)c->gap + off);
      CHECK_LE(on_a, off + 0.01 * (double)c->gap);
      if (b->count == 1) CHECK_LE(-off, on_b);
      if (a->count == 1) CHECK_LE(-off - 0.01 * (double)c->gap, on_a);
    }
    if (is_first && answer.why == 0 && answer.time.high > 0) {
      const double late = (double)(answer.time.high - answer.time.low);
      CHECK_LE(late, (double)0.01f);
      sum->firsts++;
    }
  }
  CHECK_LE((double)answer.distance.low, fmax(least, 0) + off);
  if (q->ask == NSVCD_ASK_DISTANCE && answer.why == 0 && answer.verdict == NSVCD_FREE) {
    const double width = (double)(answer.distance.high - answer.distance.low);
    CHECK_LE(least - off, (double)answer.distance.high + (double)q->to);
    CHECK_LE(width, 1.02 * (double)q->to + off);
    sum->widest = fmax(sum->widest, width);
  }
  sum->free += answer.verdict == NSVCD_FREE;
  sum->hits += answer.verdict == NSVCD_HIT;
  sum->inside += answer.inside != 0;
  sum->undecided += answer.verdict == NSVCD_UNDECIDED;
}

static void round_bodies_are_exact(void) {
  shapes_rng rng = {31};
  round_sum sum;
  memset(&sum, 0, sizeof sum);
  for (int n = 0; n < (int)check_many(15) * KINDS * KINDS; n++) {
    round_body a = round_make(&rng, n % KINDS);
    round_body b = round_make(&rng, n / KINDS % KINDS);
    nsvcd_question q;
    nsvcd_pose poses[2][2];
    double way[3], place[3];
    memset(&q, 0, sizeof q);
    q.a.scale = shapes_pick(&rng, 2) ? 1 : (float)shapes_uniform(&rng, 0.3, 3);
    q.b.scale = shapes_pick(&rng, 2) ? 1 : (float)shapes_uniform(&rng, 0.3, 3);
    shapes_direction(&rng, way);
    shapes_direction(&rng, place);
    const double reach = (double)q.a.scale * a.reach + (double)q.b.scale * b.reach;
    for (int k = 0; k < 4; k++) {
      oracle_pose pose;
      shapes_quaternion(&rng, pose.rotation);
      for (int i = 0; i < 3; i++)
        pose.position[i] = k < 2 ? reach * (0.8 * place[i] + (k ? 0.7 : -0.7) * way[i]) : 0.1 * i;
      poses[k / 2][k % 2] = pose_rounded(&pose);
      // not so much of a turn that it is all of the motion; of every third, none
      for (int i = 0; i < 4 && k % 2; i++) {
        float *to = poses[k / 2][1].rotation;
        const float fraction = n / (KINDS * KINDS) % 3 ? 0.3f : 0;
        to[i] = fraction * to[i] + (1 - fraction) * poses[k / 2][0].rotation[i];
      }
      float *r = poses[k / 2][k % 2].rotation;
      const float length = sqrtf(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
      for (int i = 0; i < 4; i++) r[i] /= length;
    }
    q.a.body = a.body;
    q.a.poses = poses[0];
    q.a.count = 2;
    q.b.body = b.body;
    q.b.poses = poses[1];
    q.b.count = 1 + (size_t)shapes_pick(&rng, 2);
    q.clearance = shapes_pick(&rng, 2) ? 0 : 0.01f;
    round_judge(&q, &a, &b, &sum);
    q.ask = NSVCD_ASK_FIRST;
    q.to_time = 0.01f;
    round_judge(&q, &a, &b, &sum);
    q.ask = NSVCD_ASK_DISTANCE;
    q.to_time = 0;
    q.to = 1e-3f;
    round_judge(&q, &a, &b, &sum);
    round_free(&a);
    round_free(&b);
  }
  printf("  free %zu, hits %zu (inside %zu), undecided %zu; first contacts %zu; widest %.2g m\n",
         sum.free, sum.hits, sum.inside, sum.undecided, sum.firsts, sum.widest);
  CHECK_GE(sum.free, check_many(200));
  CHECK_GE(sum.hits, check_many(200));
  CHECK_GE(sum.firsts, check_many(50));
  CHECK_LE(sum.undecided, check_many(10));
}

// A sphere flies through a cloud: the nearest it comes to a point of it is known, and when it is so
// near first that they touch.
static void round_spheres_in_clouds(void) {
  enum { POINTS = 20000 };
  static float points[3 * POINTS];
  shapes_rng rng = {32};
  const nsvcd_body *sphere = NULL;
  const nsvcd_body *cloud = NULL;
  size_t hits = 0;
  for (size_t i = 0; i < 3 * POINTS; i++) points[i] = (float)shapes_uniform(&rng, -1, 1);
  CHECK_EQ(nsvcd_encode_sphere(0.02f, NULL, &sphere), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_cloud(points, POINTS, 0.01f, NULL, &cloud), NSVCD_OK);
  const double quanta = (double)nsvcd_body_describe(cloud).quantization_error + 1e-6;
  for (int n = 0; n < 400; n++) {
    double ends[2][3];
    nsvcd_pose path[2];
    for (int k = 0; k < 2; k++) {
      for (int i = 0; i < 3; i++) {
        ends[k][i] = shapes_uniform(&rng, -1.2, 1.2);
        // most of them short, for else all hit
        if (k) ends[k][i] = ends[0][i] + (n % 4 ? 0.05 : 1) * ends[k][i];
        path[k].position[i] = (float)ends[k][i];
        ends[k][i] = (double)path[k].position[i];
      }
      const float unit[4] = {0, 0, 0, 1};
      memcpy(path[k].rotation, unit, sizeof unit);
    }
    double least = DBL_MAX;
    double earliest = 1;
    double root = 0;
    double way[3];
    oracle_sub(ends[1], ends[0], way);
    const double square = oracle_dot(way, way);
    for (size_t i = 0; i < POINTS; i++) {
      double d[3];
      for (int k = 0; k < 3; k++) d[k] = (double)points[3 * i + (size_t)k] - ends[0][k];
      const double along = oracle_dot(d, way) / square;
      const double t = fmin(fmax(along, 0), 1);
      const double early = along * along - (oracle_dot(d, d) - 0.03 * 0.03) / square;
      if (early > 0 && along + sqrt(early) > 0 && along - sqrt(early) < earliest) {
        earliest = fmax(along - sqrt(early), 0);
        root = sqrt(early);
      }
      for (int k = 0; k < 3; k++) d[k] -= t * way[k];
      least = fmin(least, oracle_length(d));
    }
    nsvcd_question q = question_of(sphere, path, 2, cloud, NULL, NULL);
    static NSVCD_MEMORY(workspace, 1 << 20);
    nsvcd_answer answer;
    CHECK_EQ(nsvcd_sweep(&q, workspace, sizeof workspace, &answer), NSVCD_OK);
    if (fabs(least - 0.03) > 1e-6) CHECK_EQ(answer.verdict, least < 0.03 ? NSVCD_HIT : NSVCD_FREE);
    q.ask = NSVCD_ASK_FIRST;
    q.to = 1e-4f;
    CHECK_EQ(nsvcd_sweep(&q, workspace, sizeof workspace, &answer), NSVCD_OK);
    if (answer.verdict == NSVCD_HIT) {
      // how long it takes to be nearer by what stored points are off: long, where they graze
      const double off = 1e-6 + 0.03 * quanta / (square * fmax(root, 1e-3));
      CHECK_LE((double)answer.time.low, earliest + off);
      CHECK_LE(earliest, (double)answer.time.high + off);
      CHECK_LE((double)answer.time.high, (double)answer.time.low + 1.001e-4 / sqrt(square) + 1e-6);
    }
    q.ask = NSVCD_ASK_DISTANCE;
    CHECK_EQ(nsvcd_sweep(&q, workspace, sizeof workspace, &answer), NSVCD_OK);
    CHECK_LE((double)answer.distance.low, fmax(least - 0.03, 0) + 1e-6);
    if (least > 0.03) CHECK_LE(least - 0.03, (double)answer.distance.high + 1e-6);
    hits += least < 0.03;
  }
  printf("  400 flights through 20,000 points, %zu hit one\n", hits);
  CHECK(hits > 50 && hits < 350);
  nsvcd_body_free(sphere, NULL);
  nsvcd_body_free(cloud, NULL);
}

// Two clouds pass each other, and hardly any work is allowed: what is said of their distance is so,
// and clouds that are known to touch are hit.
static void round_distances_of_little_work(void) {
  enum { POINTS = 40 };
  shapes_rng rng = {36};
  const float radius = 0.04f;
  float points[2][3 * POINTS];
  const nsvcd_body *clouds[2] = {NULL, NULL};
  size_t hits = 0;
  size_t others = 0;
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < 3 * POINTS; i++) points[k][i] = (float)shapes_uniform(&rng, -0.15, 0.15);
    CHECK_EQ(nsvcd_encode_cloud(points[k], POINTS, radius, NULL, &clouds[k]), NSVCD_OK);
  }
  for (int n = 0; n < 600; n++) {
    nsvcd_pose path[2] = {{{0, 0, 0.6f}, {0, 0, 0, 1}}, {{0, 0, -0.6f}, {0, 0, 0, 1}}};
    for (int k = 0; k < 4; k++)
      path[k / 2].position[k % 2] = (float)shapes_uniform(&rng, -0.6, 0.6);
    double from[3], way[3];
    double least = DBL_MAX;
    for (int k = 0; k < 3; k++) {
      from[k] = (double)path[0].position[k];
      way[k] = (double)path[1].position[k] - from[k];
    }
    for (int i = 0; i < POINTS * POINTS; i++) {
      double d[3];
      for (int k = 0; k < 3; k++)
        d[k] = (double)points[1][3 * (i / POINTS) + k] - (double)points[0][3 * (i % POINTS) + k] -
               from[k];
      const double t = fmin(fmax(oracle_dot(d, way) / oracle_dot(way, way), 0), 1);
      for (int k = 0; k < 3; k++) d[k] -= t * way[k];
      least = fmin(least, oracle_length(d));
    }
    nsvcd_question q = question_of(clouds[0], path, 2, clouds[1], NULL, NULL);
    q.ask = NSVCD_ASK_DISTANCE;
    q.clearance = n % 3 ? 0 : 0.02f;
    q.work = 1 + (size_t)(n % 7);
    const double gap = fmax(least - 2 * (double)radius, 0);
    const double clearance = (double)q.clearance;
    const nsvcd_answer answer = round_ask(&q);
    CHECK_GE(answer.distance.low, 0);
    CHECK_LE((double)answer.distance.low, gap + 1e-5);
    CHECK_GE((double)answer.distance.high, gap - 1e-5);
    if (gap > clearance + 1e-5) CHECK(answer.verdict != NSVCD_HIT);
    if (gap < clearance - 1e-5) CHECK(answer.verdict != NSVCD_FREE);
    if ((double)answer.distance.high <= clearance) CHECK_EQ(answer.verdict, NSVCD_HIT);
    if (answer.verdict == NSVCD_HIT) {
      CHECK_EQ(answer.contact_count, 1);
      CHECK(answer.nearest.triangle_a < POINTS && answer.nearest.triangle_b < POINTS);
      CHECK_LE((double)answer.nearest.gap, clearance + 1e-5);
    }
    hits += answer.verdict == NSVCD_HIT;
    others += answer.verdict != NSVCD_HIT;
  }
  printf("  of little work: %zu hits, %zu others\n", hits, others);
  CHECK(hits > 50 && others > 50);
  for (int k = 0; k < 2; k++) nsvcd_body_free(clouds[k], NULL);
}

// Two balls fly at each other: when they meet is known, and is between the times that are told, as
// these are rounded.
static void round_times_hold_the_first_contact(void) {
  shapes_rng rng = {37};
  const nsvcd_body *ball = NULL;
  CHECK_EQ(nsvcd_encode_sphere(0.25f, NULL, &ball), NSVCD_OK);
  for (int n = 0; n < 300; n++) {
    const nsvcd_pose path[2] = {
        {{0, 0, (float)pow(10, shapes_uniform(&rng, 0, 3.7))}, {0, 0, 0, 1}},
        {{0, 0, (float)shapes_uniform(&rng, -0.3, 0.4)}, {0, 0, 0, 1}}};
    const double from = (double)path[0].position[2];
    const double when = (from - 0.5) / (from - (double)path[1].position[2]);
    nsvcd_question q = question_of(ball, path, 2, ball, NULL, NULL);
    for (int k = 0; k < 2; k++) {
      q.ask = k ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
      const nsvcd_answer answer = round_ask(&q);
      CHECK_EQ(answer.verdict, NSVCD_HIT);
      CHECK_LE((double)answer.time.low, when * (1 + 1e-12));
      CHECK_GE((double)answer.time.high, when * (1 - 1e-12));
      CHECK_LE((double)answer.safe.time, (double)answer.time.low);
    }
  }
  nsvcd_body_free(ball, NULL);
}

// What lies on a table or in it, by less than a skin: lifted by the skin, deep by what it is, on its
// two ends, its four corners, its one point.
static void round_bodies_lie_on_a_table(void) {
  static const float ends[2][3] = {{-0.2f, 0, 0}, {0.2f, 0, 0}};
  static const float half[3] = {0.2f, 0.15f, 0.1f};
  const nsvcd_body *table = NULL;
  const nsvcd_body *bodies[3] = {NULL, NULL, NULL};
  const float table_half[3] = {1, 1, 0.1f};
  CHECK_EQ(nsvcd_encode_box(table_half, 0, NULL, &table), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_sphere(0.1f, NULL, &bodies[0]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_capsule(ends[0], ends[1], 0.1f, NULL, &bodies[1]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_box(half, 0.03f, NULL, &bodies[2]), NSVCD_OK);
  for (int n = 0; n < 300; n++) {
    const int kind = n % 3;
    const int contacts[3] = {1, 2, 4};
    // 1 um to 0.95 mm
    const double depth = 1e-6 * pow(950, n / 300.0);
    const double turn = 0.02 * n;
    const nsvcd_pose at = {{0.01f, 0.02f, (float)(0.2 - depth)},
                           {0, 0, (float)sin(turn), (float)cos(turn)}};
    nsvcd_pose path[2] = {at, at};
    path[1].position[0] += 0.1f;
    nsvcd_question q = question_of(bodies[kind], path, 2, table, NULL, NULL);
    q.slop = 1e-3f;
    nsvcd_answer answer = round_ask(&q);
    CHECK_EQ(answer.verdict, NSVCD_FREE);
    CHECK_NEAR(answer.push_out[2], 1e-3, 1e-5);
    // half of the table's quantum
    CHECK_NEAR(answer.depth, depth, 0.01 * depth + 1.2e-5);
    q.a.poses = &answer.safe.a;
    q.a.count = 1;
    q.slop = 0;
    CHECK_EQ(round_ask(&q).verdict, NSVCD_FREE);

    path[0].position[2] = 0.21f;
    path[1] = path[0];
    path[1].position[2] = 0.15f;
    q.a.poses = path;
    q.a.count = 2;
    q.ask = NSVCD_ASK_FIRST;
    q.to = 1e-4f;
    q.manifold = 1;
    answer = round_ask(&q);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_EQ(answer.contact_count, contacts[kind]);
    for (size_t k = 0; k < answer.contact_count; k++) {
      const nsvcd_contact *c = &answer.contacts[k];
      const double across = hypot((double)c->point[0] - 0.01, (double)c->point[1] - 0.02);
      const double where[3] = {0, 0.2, hypot(0.17, 0.12)};
      CHECK_NEAR(across, where[kind], 1e-5);
      CHECK_NEAR(c->point[2], 0.1, 1e-5);
      CHECK_NEAR(c->normal[2], 1, 1e-5);
      CHECK(c->gap >= 0 && c->gap <= 1.02e-4f);
    }
    // of a contact from the start too, and of the table under it
    path[0].position[2] = (float)(0.2 - depth);
    answer = round_ask(&q);
    CHECK_EQ(answer.time.high, 0);
    CHECK_EQ(answer.contact_count, contacts[kind]);
    const nsvcd_mover mover = q.a;
    q.a = q.b;
    q.b = mover;
    answer = round_ask(&q);
    CHECK_EQ(answer.contact_count, contacts[kind]);
    CHECK_NEAR(answer.contacts[0].normal[2], -1, 1e-5);
    CHECK_NEAR(answer.contacts[0].point[2], 0.1, depth + 1e-5);
  }
  nsvcd_body_free(table, NULL);
  for (int k = 0; k < 3; k++) nsvcd_body_free(bodies[k], NULL);
}

// A box lies on a ball, and the ball turns by half a turn: the lift turns with the larger of the two,
// roundness and all. If that is the ball, the box is under the lift in the end, and hit; if it is
// the box, both go apart.
static void round_lifts_turn_with_the_larger(void) {
  const float half[3] = {0.005f, 0.005f, 0.005f};
  const nsvcd_body *ball = NULL;
  const nsvcd_body *box = NULL;
  CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &box), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_sphere(0.1f, NULL, &ball), NSVCD_OK);
  const float side = 0.70710678f;
  const nsvcd_pose turns[3] = {
      {{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {side, 0, 0, side}}, {{0, 0, 0}, {1, 0, 0, 0}}};
  for (int n = 0; n < 8; n++) {
    const int ball_is_a = n & 1;
    const int box_is_larger = n & 2;
    const float scale = box_is_larger ? 40 : n & 4 ? 2 : 1;
    const float height = 0.1f + 0.005f * scale;
    const nsvcd_pose lies[2] = {{{0, 0, height}, {0, 0, 0, 1}}, {{0, 0, height}, {0, 0, 0, 1}}};
    nsvcd_question q = question_of(box, lies, 2, ball, NULL, NULL);
    q.a.scale = scale;
    q.b.poses = turns;
    q.b.count = 3;
    q.slop = 2e-3f;
    if (ball_is_a) {
      const nsvcd_mover mover = q.a;
      q.a = q.b;
      q.b = mover;
    }
    const nsvcd_answer answer = round_ask(&q);
    CHECK_NEAR(answer.push_out[2], ball_is_a ? -2e-3 : 2e-3, 2e-5);
    CHECK_EQ(answer.verdict, box_is_larger ? NSVCD_FREE : NSVCD_HIT);
  }
  nsvcd_body_free(ball, NULL);
  nsvcd_body_free(box, NULL);
}

// What encloses does so whatever else is in the mesh: a face that names a vertex twice, as exports
// have them, a capsule beside it, a ball within. A ball of 2 cm flies inside of a box, or of a cut
// one, which is nearly a solid.
static void round_boxes_enclose(void) {
  // corner n is on the far side of axis k if bit 2 - k of n is set; then what is added
  static const uint32_t faces[36] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                     2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  static const uint32_t added[6][3] = {{0, 0, 0}, {0, 1, 1}, {5, 7, 5},
                                       {8, 9, 9}, {9, 8, 8}, {10, 10, 10}};
  const nsvcd_pose path[2] = {{{0.2f, 0.1f, -0.1f}, {0, 0, 0, 1}},
                              {{-0.2f, 0.1f, -0.1f}, {0, 0, 0, 1}}};
  const nsvcd_body *ball = NULL;
  CHECK_EQ(nsvcd_encode_sphere(0.02f, NULL, &ball), NSVCD_OK);
  for (int n = 0; n < 6 * 2 * 3; n++) {
    const int extra = n % 6;
    const int is_cut = n / 6 % 2;
    const size_t patches[3] = {0, 3, 64};
    float positions[33];
    uint32_t corners[39];
    nsvcd_mesh mesh = {positions, corners, 11, extra ? 13 : 12};
    nsvcd_encode_options options;
    memset(&options, 0, sizeof options);
    options.convex_radius = 1e-3f;
    options.patches = patches[n / 12];
    for (int k = 0; k < 24; k++) positions[k] = k / 3 >> (2 - k % 3) & 1 ? 0.5f : -0.5f;
    // far from it, but for the last one
    for (int k = 24; k < 33; k++) positions[k] = k < 30 ? 3 + 0.1f * (float)k : 0.45f;
    memcpy(corners, faces, sizeof faces);
    memcpy(corners + 36, added[extra], sizeof added[extra]);
    // a face is gone: of one that names a vertex twice no more than that is left
    if (is_cut) corners[35] = corners[34];
    const nsvcd_body *box = NULL;
    CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &box), NSVCD_OK);
    nsvcd_question q = question_of(ball, path, 2, box, NULL, NULL);
    const nsvcd_answer answer = round_ask(&q);
    CHECK_EQ(answer.verdict, is_cut ? NSVCD_UNDECIDED : NSVCD_HIT);
    CHECK_EQ(answer.inside, !is_cut);
    if (is_cut) CHECK_EQ(answer.why, NSVCD_WHY_OPEN);
    nsvcd_body_free(box, NULL);
  }
  nsvcd_body_free(ball, NULL);
}

// Two balls as large as their scales make them, in double, or nearer to each other than that by
// less than what float resolves, with a clearance as well: those that overlap are never free, nor
// hit those that are as much apart. One of them may be scaled before.
static void round_scales_are_exact(void) {
  static NSVCD_MEMORY(room, 4096);
  shapes_rng rng = {34};
  const float radii[2] = {0.7f, 0.0123f};
  const nsvcd_body *balls[2] = {NULL, NULL};
  size_t free_ones = 0;
  for (int k = 0; k < 2; k++) CHECK_EQ(nsvcd_encode_sphere(radii[k], NULL, &balls[k]), NSVCD_OK);
  for (int n = 0; n < 1200; n++) {
    const int kind = n % 3;
    float scales[2];
    double sum = 0;
    for (int k = 0; k < 2; k++) {
      scales[k] = (float)shapes_uniform(&rng, 0.1, 3);
      sum += (double)radii[k] * (double)scales[k];
    }
    nsvcd_question q = question_of(balls[0], NULL, 1, balls[1], NULL, NULL);
    q.clearance = kind == 1 ? (float)shapes_uniform(&rng, 0, 9) : 0;
    q.a.scale = scales[0];
    q.b.scale = scales[1];
    sum += (double)q.clearance;
    double quantum = 0;
    if (kind == 2) {
      CHECK_EQ(nsvcd_body_scale(balls[0], (const float[3]){scales[0], scales[0], scales[0]}, room,
                                sizeof room, &q.a.body),
               NSVCD_OK);
      q.a.scale = 0;
      quantum = (double)nsvcd_body_describe(q.a.body).quantization_error;
    }
    double way[3];
    for (int k = 0; k < 3; k++) way[k] = shapes_uniform(&rng, -1, 1);
    const double apart = sum * (1 + shapes_uniform(&rng, -3e-7, 3e-7)) / oracle_length(way);
    double square = 0;
    nsvcd_pose pose = {{0, 0, 0}, {0, 0, 0, 1}};
    for (int k = 0; k < 3; k++) {
      pose.position[k] = (float)(apart * way[k]);
      square += (double)pose.position[k] * (double)pose.position[k];
    }
    const double gap = sqrt(square) - sum;
    q.a.poses = &pose;
    const nsvcd_answer answer = round_ask(&q);
    if (gap < 0) CHECK(answer.verdict != NSVCD_FREE);
    if (gap > 1e-12 * sum + 2 * quantum) CHECK_EQ(answer.verdict, NSVCD_FREE);
    free_ones += answer.verdict == NSVCD_FREE;
  }
  CHECK_GE(free_ones, 300);
  for (int k = 0; k < 2; k++) nsvcd_body_free(balls[k], NULL);
}

// Boxes whose meshes lie far from their own origin, scaled: how large they are about it counts, to
// the last digit.
static void round_scales_about_far_origins(void) {
  shapes_rng rng = {35};
  size_t free_ones = 0;
  for (int n = 0; n < 12; n++) {
    const double far_off = pow(10, 3 + n % 3) * shapes_uniform(&rng, 0.3, 1);
    const nsvcd_body *bodies[2] = {NULL, NULL};
    double ends[2] = {0, 0};  // of the first the near side, of the other one its far side
    for (int k = 0; k < 2; k++) {
      shapes_mesh shape;
      memset(&shape, 0, sizeof shape);
      shapes_box(&shape, 0.7, 0.6, 0.5, 1);
      float positions[72];
      nsvcd_mesh mesh = {positions, shape.indices, shape.vertices, shape.triangles};
      CHECK_EQ(shape.vertices, 24);
      for (int i = 0; i < 72; i++) {
        positions[i] = (float)(shape.positions[i] + (k == 0 && i % 3 == 0 ? far_off : 0));
        const double x = (double)positions[i];
        if (i % 3 == 0 && (i == 0 || (k == 0 ? x < ends[0] : x > ends[1]))) ends[k] = x;
      }
      CHECK_EQ(nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &bodies[k]), NSVCD_OK);
      shapes_free(&shape);
    }
    for (int trial = 0; trial < 100; trial++) {
      const float scale = (float)shapes_uniform(&rng, 0.1, 3);
      const float other = (float)shapes_uniform(&rng, 0.1, 3);
      const double near_side = (double)scale * ends[0];
      const double far_side = (double)other * ends[1];
      nsvcd_pose path[2] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}};
      path[0].position[0] =
          (float)(far_side - near_side - shapes_uniform(&rng, -1.2e-7, 1.2e-7) * near_side);
      path[1].position[0] = path[0].position[0] + 0.3f;
      nsvcd_question q = question_of(bodies[0], path, 2, bodies[1], NULL, NULL);
      q.a.scale = scale;
      q.b.scale = other;
      const nsvcd_answer answer = round_ask(&q);
      const double gap = (double)path[0].position[0] + near_side - far_side;
      if (gap < 0) CHECK(answer.verdict != NSVCD_FREE);
      free_ones += answer.verdict == NSVCD_FREE;
    }
    for (int k = 0; k < 2; k++) nsvcd_body_free(bodies[k], NULL);
  }
  CHECK_GE(free_ones, 100);
}

// A capsule dives through the middle of a large face, either end first, far from the face's edges: the
// nearest points are an end's until the segment crosses the face, and there it is found too.
static void round_capsules_dive(void) {
  const float ends[2][3] = {{0, 0, -0.2f}, {0, 0, 0.2f}};
  const float half[3] = {1, 1, 0.05f};
  const nsvcd_body *box = NULL;
  CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &box), NSVCD_OK);
  for (int n = 0; n < 24; n++) {
    const nsvcd_body *capsule = NULL;
    const float round = n % 3 ? 0.01f : 1e-4f;
    const float x = 0.3f + 0.02f * (float)n;
    CHECK_EQ(nsvcd_encode_capsule(ends[n % 2], ends[1 - n % 2], round, NULL, &capsule), NSVCD_OK);
    nsvcd_pose path[2] = {{{x, 0.2f, 1}, {0, 0, 0, 1}}, {{x, 0.2f, -1}, {0, 0, 0, 1}}};
    nsvcd_question q = question_of(capsule, path, 2, box, NULL, NULL);
    CHECK_EQ(round_ask(&q).verdict, NSVCD_HIT);
    q.ask = NSVCD_ASK_FIRST;
    q.to = 1e-4f;
    const nsvcd_answer answer = round_ask(&q);
    const double first = (1 - 0.05 - 0.2 - (double)round) / 2;
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_LE((double)answer.time.low, first + 1e-6);
    CHECK_NEAR(answer.time.high, first, 1e-4);
    // across the face already, and moving along it
    path[0].position[2] = path[1].position[2] = n % 4 < 2 ? 0.1f : 0;
    path[1].position[0] += 0.1f;
    q = question_of(capsule, path, 2, box, NULL, NULL);
    CHECK_EQ(round_ask(&q).verdict, NSVCD_HIT);
    nsvcd_body_free(capsule, NULL);
  }
  nsvcd_body_free(box, NULL);
}

// Thin capsules, one end inside of a box and one outside, at any slant: the surfaces meet, which is
// found at once, fused products or not. A segment's normal, a vector across itself, is 0 by neither.
static void round_slanted_capsules_cross(void) {
  const float half[3] = {0.3f, 0.2f, 0.1f};
  const nsvcd_body *box = NULL;
  shapes_rng rng = {19};
  CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &box), NSVCD_OK);
  for (int n = 0; n < 300;) {
    float ends[2][3];
    int inside[2] = {1, 1};
    int clear = 1;
    for (int k = 0; k < 6; k++) {
      const double x = shapes_uniform(&rng, -0.35, 0.35);
      ends[k / 3][k % 3] = (float)x;
      inside[k / 3] &= fabs(x) < (double)half[k % 3];
      clear &= fabs(fabs(x) - (double)half[k % 3]) > 0.01;
    }
    if (!clear || inside[0] == inside[1]) continue;
    n++;
    const nsvcd_body *capsule = NULL;
    const nsvcd_pose still = {{0, 0, 0}, {0, 0, 0, 1}};
    CHECK_EQ(nsvcd_encode_capsule(ends[0], ends[1], 1e-4f, NULL, &capsule), NSVCD_OK);
    nsvcd_question q = question_of(capsule, &still, 1, box, NULL, NULL);
    q.surfaces = 1;
    const nsvcd_answer answer = round_ask(&q);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_LE(answer.work, 100);
    nsvcd_body_free(capsule, NULL);
  }
  nsvcd_body_free(box, NULL);
}

static void round_refuses_bad_input(void) {
  const float good[6] = {0, 0, 0, 1, 0, 0};
  const float bad[6] = {0, 0, 0, NAN, 0, 0};
  const float far_off[3] = {3e6f, 0, 0};
  const float flat[3] = {1, 0, 1};
  const float radii[4] = {0, -1, NAN, HUGE_VALF};
  const nsvcd_body *body = NULL;
  for (int k = 0; k < 4; k++) {
    CHECK_EQ(nsvcd_encode_sphere(radii[k], NULL, &body), NSVCD_ERROR_RADIUS);
    CHECK_EQ(nsvcd_encode_capsule(good, good + 3, radii[k], NULL, &body), NSVCD_ERROR_RADIUS);
    CHECK_EQ(nsvcd_encode_cloud(good, 2, radii[k], NULL, &body), NSVCD_ERROR_RADIUS);
    if (k) CHECK_EQ(nsvcd_encode_box(good + 3, radii[k], NULL, &body), NSVCD_ERROR_RADIUS);
  }
  CHECK_EQ(nsvcd_encode_sphere(1, NULL, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_encode_capsule(NULL, good, 1, NULL, &body), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_encode_capsule(bad, bad + 3, 1, NULL, &body), NSVCD_ERROR_NUMBER);
  CHECK_EQ(nsvcd_encode_capsule(good, far_off, 1, NULL, &body), NSVCD_ERROR_NUMBER);
  CHECK_EQ(nsvcd_encode_box(flat, 0, NULL, &body), NSVCD_ERROR_RADIUS);
  CHECK_EQ(nsvcd_encode_cloud(NULL, 2, 1, NULL, &body), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_encode_cloud(good, 0, 1, NULL, &body), NSVCD_ERROR_EMPTY);
  CHECK_EQ(nsvcd_encode_cloud(bad, 2, 1, NULL, &body), NSVCD_ERROR_NUMBER);
  const uint32_t corners[3] = {0, 1, 1};
  nsvcd_mesh mesh = {(float *)malloc(sizeof good), (uint32_t *)malloc(sizeof corners), 2, 1};
  if (!mesh.positions || !mesh.indices) exit(1);
  memcpy(mesh.positions, good, sizeof good);
  memcpy(mesh.indices, corners, sizeof corners);
  nsvcd_encode_options options = {.convex_radius = -1};
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_ERROR_RADIUS);
  options.convex_radius = 0;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_ERROR_EMPTY);
  options.convex_radius = 1;
  options.no_triangles = 1;
  CHECK_EQ(nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body), NSVCD_ERROR_LATENTS);
  CHECK(body == NULL);
  nsvcd_mesh_free(&mesh, NULL);
  // a capsule of no length is a sphere
  CHECK_EQ(nsvcd_encode_capsule(good, good, 1, NULL, &body), NSVCD_OK);
  CHECK_NEAR(nsvcd_body_describe(body).radius, 1, 1e-5);
  nsvcd_body_free(body, NULL);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

static void round_bodies_are_saved_and_scaled(void) {
  shapes_rng rng = {33};
  for (int n = 0; n < 4 * KINDS; n++) {
    round_body b = round_make(&rng, n % KINDS);
    const nsvcd_body_facts facts = nsvcd_body_describe(b.body);
    void *copy = malloc(facts.size);
    const nsvcd_body *loaded = NULL;
    if (!copy) exit(1);
    memcpy(copy, b.body, facts.size);
    CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_OK);
    CHECK_EQ(nsvcd_body_scale(b.body, (const float[3]){2, 2, 2}, copy, facts.size, &loaded),
             NSVCD_OK);
    CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_OK);
    const nsvcd_body_facts scaled = nsvcd_body_describe(loaded);
    CHECK_EQ(scaled.convex_radius, 2 * facts.convex_radius);
    CHECK_NEAR(scaled.radius, 2 * (double)facts.radius, 1e-5 * (double)scaled.radius);
    // what is round is checked as all else is
    for (int k = 0; k < 3; k++) {
      const float forged[3] = {-1, NAN, 1e30f};
      nsvcd_body *own = (nsvcd_body *)copy;
      float *round = (float *)nsvcd__writable(own, &nsvcd__counts_of(own)->convex_radius);
      *round = forged[k];
      own->checksum = nsvcd__body_checksum(own);
      CHECK_EQ(nsvcd_body_load(copy, facts.size, &loaded), NSVCD_ERROR_BODY);
    }
    free(copy);
    round_free(&b);
  }
}

void test_round(void) {
  RUN(round_refuses_bad_input);
  RUN(round_boxes_enclose);
  RUN(round_times_hold_the_first_contact);
  RUN(round_distances_of_little_work);
  RUN(round_lifts_turn_with_the_larger);
  RUN(round_scales_are_exact);
  RUN(round_scales_about_far_origins);
  RUN(round_spheres_in_clouds);
  RUN(round_bodies_lie_on_a_table);
  RUN(round_capsules_dive);
  RUN(round_slanted_capsules_cross);
  RUN(round_bodies_are_exact);
  // from within
  RUN(round_bodies_are_saved_and_scaled);
}

CHECK_ALONE(test_round)
