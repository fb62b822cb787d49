// Motions of many poses and many turns, which are searched interval by interval. A box goes over a
// wide slab: how high its lowest corner is, in double, is the truth.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/query/question.h"
#include "../src/body/shapes.h"

#include "check.h"
#include "random_motions.h"

void test_long(void);

#define LONG_POSES NSVCD_MAX_POSES
static const float long_half[3] = {0.03f, 0.02f, 0.01f};
static const float long_slab[3] = {2, 2, 0.1f};
static nsvcd_pose long_fixed[LONG_POSES];
static float long_times[2][LONG_POSES];

static nsvcd_answer long_ask(const nsvcd_question *question) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(64, 64, 64));
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_sweep(question, workspace, sizeof workspace, &answer), NSVCD_OK);
  return answer;
}

static const nsvcd_body *long_box(const float *half) {
  const nsvcd_body *body = NULL;
  CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &body), NSVCD_OK);
  return body;
}

// A time as a share of the way through poses that are uniform.
static double long_uniform(const nsvcd_mover *mover, double t) {
  size_t k = 0;
  if (!mover->times || mover->count == 1) return t;
  while (k + 2 < mover->count && (double)mover->times[k + 1] <= t) k++;
  const double from = (double)mover->times[k];
  const double u = (t - from) / ((double)mover->times[k + 1] - from);
  return ((double)k + u) / (double)(mover->count - 1);
}

// How high the box is over the slab, which does not turn.
static double long_height(const nsvcd_question *q, double t) {
  const oracle_pose a = pose_at(q->a.poses, q->a.count, long_uniform(&q->a, t));
  double least = HUGE_VAL;
  double under = (double)long_slab[2];
  if (q->b.count) under += pose_at(q->b.poses, q->b.count, long_uniform(&q->b, t)).position[2];
  for (int n = 0; n < 8; n++) {
    double corner[3], turned[3];
    for (int k = 0; k < 3; k++) corner[k] = (n >> k & 1 ? 1 : -1) * (double)long_half[k];
    oracle_transform(&a, corner, turned);
    least = fmin(least, turned[2] - under);
  }
  return least;
}

static void long_rise(float *times, size_t count) {
  double sum = 0;
  times[0] = 0;
  for (size_t n = 1; n < count; n++) {
    sum += uniform(0, 1) < 0.1 ? 5 : uniform(0.2, 1);
    times[n] = (float)sum;
  }
  for (size_t n = 1; n < count; n++) times[n] = (float)((double)times[n] / sum);
  times[count - 1] = 1;
}

// The box tumbles over the slab, never lower than `gap`, turning by so much from pose to pose.
static void long_tumble(size_t count, double turn, double gap) {
  double height = 0;
  for (int k = 0; k < 3; k++) height += (double)long_half[k] * (double)long_half[k];
  height = sqrt(height) + (double)long_slab[2] + gap;
  for (size_t n = 0; n < count; n++) {
    const double half = 0.5 * turn * (double)n;
    nsvcd_pose *at = &poses[n];
    at->position[0] = (float)(0.5 * sin(0.37 * (double)n));
    at->position[1] = (float)(0.5 * cos(0.11 * (double)n));
    at->position[2] = (float)height;
    at->rotation[0] = (float)(0.6 * sin(half));
    at->rotation[1] = (float)(0.8 * sin(half));
    at->rotation[2] = 0;
    at->rotation[3] = (float)cos(half);
  }
}

// The same over a slab that goes up and down by itself, by `way`, in its own poses, and perhaps at
// times of their own.
static nsvcd_question long_question(const nsvcd_body *const *bodies, size_t count,
                                    size_t fixed_count, int timed, double way) {
  nsvcd_question q = question_of(bodies[0], poses, count, bodies[1], NULL, NULL);
  for (size_t n = 0; n < fixed_count; n++) {
    memset(&long_fixed[n], 0, sizeof long_fixed[n]);
    long_fixed[n].position[2] = (float)(n % 2 ? way : -way);
    long_fixed[n].rotation[3] = 1;
  }
  if (fixed_count) q.b.poses = long_fixed;
  q.b.count = fixed_count;
  for (int n = 0; n < 2; n++) {
    nsvcd_mover *mover = n ? &q.b : &q.a;
    if (!(timed >> n & 1) || mover->count < 2) continue;
    long_rise(long_times[n], mover->count);
    mover->times = long_times[n];
  }
  return q;
}

// The least height near a pose, and when it is 0 first.
static double long_lowest(const nsvcd_question *q, size_t k, double *first) {
  const double last = (double)(q->a.count - 1);
  double least = HUGE_VAL;
  *first = 2;
  for (int n = -4000; n <= 4000; n++) {
    const double at = (double)k + 2.0 * n / 4000;
    double t = at / last;
    if (at < 0 || at > last) continue;
    if (q->a.times) {
      const size_t from = (size_t)fmin(floor(at), last - 1);
      const double u = at - (double)from;
      t = (1 - u) * (double)q->a.times[from] + u * (double)q->a.times[from + 1];
    }
    const double height = long_height(q, t);
    if (height <= 0 && *first > 1) *first = t;
    least = fmin(least, height);
  }
  return least;
}

// One pose of a long motion is lower than the rest: the slab is met about there, or missed by a
// little, and nowhere else.
static void long_one_pose_is_low(void) {
  const nsvcd_body *bodies[2] = {long_box(long_half), long_box(long_slab)};
  size_t hits = 0;
  size_t frees = 0;
  for (size_t trial = 0; trial < check_many(90); trial++) {
    const size_t count = pick(70, trial % 10 ? 300 : 2000);
    const size_t edge[6] = {0, count - 1, 63, 64, 65, 1};
    const size_t k = trial % 3 ? pick(0, count - 1) : edge[trial / 3 % 6];
    const size_t fixed_count = trial % 4 ? 0 : pick(2, 200);
    const double turn = trial % 5 ? uniform(0, 1.5) : 0;
    const double miss = trial % 2 ? uniform(-1.5e-3, -5e-4) : uniform(5e-4, 1.5e-3);
    double first;
    long_tumble(count, turn, 0.012);
    nsvcd_question q = long_question(bodies, count, fixed_count, (int)(trial / 4 % 4), 2e-3);
    const double before = long_lowest(&q, k, &first);
    poses[k].position[2] -= (float)(before - miss);
    for (int n = 0; n < 4; n++)
      poses[k].position[2] -= (float)(0.9 * (long_lowest(&q, k, &first) - miss));
    const double least = long_lowest(&q, k, &first);
    if (fabs(least) < 1e-4) continue;
    if (q.a.count % 3 == 0 && !fixed_count) q.segments = 16;
    const nsvcd_answer any = long_ask(&q);
    CHECK_EQ(any.verdict, least < 0 ? NSVCD_HIT : NSVCD_FREE);
    hits += least < 0;
    frees += least > 0;
    q.ask = NSVCD_ASK_FIRST;
    q.to_time = 1e-4f;
    const nsvcd_answer in_order = long_ask(&q);
    CHECK_EQ(in_order.verdict, any.verdict);
    if (least < 0) {
      const double slack = 1e-3 / (double)count + 2e-6;
      CHECK_LE((double)in_order.time.low, first + slack);
      // between the samples that `first` is one of it may dip in earlier: then it is in there
      const double high = (double)in_order.time.high;
      CHECK(high >= first - slack || long_height(&q, high) < 1e-9);
      CHECK_LE((double)(in_order.time.high - in_order.time.low), (double)1e-4f);
      continue;
    }
    q.to_time = 0;
    q.ask = NSVCD_ASK_DISTANCE;
    q.to = 1e-4f;
    const nsvcd_answer near = long_ask(&q);
    CHECK_EQ(near.verdict, NSVCD_FREE);
    CHECK_LE((double)near.distance.low, least + 1e-6);
    CHECK_GE((double)near.distance.high, least - 5e-5);
    // and both quanta
    CHECK_LE((double)(near.distance.high - near.distance.low), 4e-4);
    q.ask = NSVCD_ASK_HIT;
    q.to = 0;
    q.clearance = (float)(least + 1e-4);
    CHECK_EQ(long_ask(&q).verdict, NSVCD_HIT);
    q.clearance = (float)(least - 2e-4);
    CHECK_EQ(long_ask(&q).verdict, NSVCD_FREE);
  }
  printf("  %zu hits, %zu free\n", hits, frees);
  CHECK(hits > 20 && frees > 20);
  for (int n = 0; n < 2; n++) nsvcd_body_free(bodies[n], NULL);
}

// What is asked pose by pose is not answered otherwise.
static void long_pieces_agree(void) {
  const float other[3] = {0.15f, 0.1f, 0.12f};
  const nsvcd_body *bodies[2] = {long_box(long_half), long_box(other)};
  const double middle[3] = {0.1, 0.15, 0};
  size_t verdicts[3] = {0, 0, 0};
  for (size_t trial = 0; trial < check_many(60); trial++) {
    const size_t count = pick(66, 250);
    nsvcd_question asked;
    memset(&asked, 0, sizeof asked);
    random_motion(count, trial % 2, uniform(0, 120), trial % 3 ? 0.1 : 0.5, middle);
    asked.clearance = trial % 4 ? 0 : 0.004f;
    const nsvcd_question q = question_of(bodies[0], poses, count, bodies[1], NULL, &asked);
    nsvcd_question first = q;
    first.ask = NSVCD_ASK_FIRST;
    first.to_time = 1e-4f;
    nsvcd_question near = q;
    near.ask = NSVCD_ASK_DISTANCE;
    near.to = 1e-3f;
    const nsvcd_answer all = long_ask(&q);
    const nsvcd_answer in_order = long_ask(&first);
    const nsvcd_answer measured = long_ask(&near);
    int hits = 0;
    int open = 0;
    double low = HUGE_VAL;
    double high = HUGE_VAL;
    for (size_t k = 0; k + 1 < count; k++) {
      nsvcd_question part = near;
      part.a.poses = poses + k;
      part.a.count = 2;
      const nsvcd_answer one = long_ask(&part);
      const double last = (double)(count - 1);
      if (one.verdict == NSVCD_HIT && !hits && in_order.verdict == NSVCD_HIT)
        CHECK_LE((double)in_order.time.low * last, (double)(k + 1) + 1e-3);
      if (one.verdict == NSVCD_FREE && in_order.verdict == NSVCD_HIT)
        CHECK(!((double)in_order.time.high * last > (double)k + 1e-3 &&
                (double)in_order.time.high * last < (double)(k + 1) - 1e-3));
      hits += one.verdict == NSVCD_HIT;
      open += one.verdict == NSVCD_UNDECIDED;
      low = fmin(low, (double)one.distance.low);
      high = fmin(high, (double)one.distance.high);
    }
    if (!open || hits) CHECK_EQ(all.verdict, hits ? NSVCD_HIT : NSVCD_FREE);
    CHECK_EQ(in_order.verdict, all.verdict);
    CHECK_EQ(measured.verdict, all.verdict);
    verdicts[all.verdict]++;
    if (all.verdict == NSVCD_HIT) continue;
    CHECK_LE((double)measured.distance.low, high + 1e-6);
    CHECK_GE((double)measured.distance.high, low - 1e-6);
    CHECK_EQ(measured.why, NSVCD_WHY_NOTHING);
  }
  printf("  %zu hits, %zu free\n", verdicts[NSVCD_HIT], verdicts[NSVCD_FREE]);
  CHECK(verdicts[NSVCD_HIT] > 5 && verdicts[NSVCD_FREE] > 5);
  for (int n = 0; n < 2; n++) nsvcd_body_free(bodies[n], NULL);
}

// As long as motions may be; both move, whose poses are at 65,535 x 65,534 ticks; 10,000 turns.
static void long_as_may_be(void) {
  const nsvcd_body *bodies[2] = {long_box(long_half), long_box(long_slab)};
  static const size_t counts[4][2] = {
      {LONG_POSES, 0}, {LONG_POSES, LONG_POSES - 1}, {LONG_POSES, 3}, {30001, 2}};
  for (size_t n = 0; n < 4; n++) {
    long_tumble(counts[n][0], n < 3 ? 0.3 : 2.0943951, 0.008);
    nsvcd_question q = long_question(bodies, counts[n][0], counts[n][1], 0, 1e-3);
    CHECK_EQ(long_ask(&q).verdict, NSVCD_FREE);
    poses[q.a.count - 1 - n].position[2] -= 0.05f;
    // where most are: nothing is proven before
    const nsvcd_answer any = long_ask(&q);
    CHECK_EQ(any.verdict, NSVCD_HIT);
    if (n == 0) CHECK_LE((double)any.work, 100);
    q.ask = NSVCD_ASK_FIRST;
    const nsvcd_answer first = long_ask(&q);
    CHECK_EQ(first.verdict, NSVCD_HIT);
    CHECK_GE((double)first.time.low, 0.999);
  }
  for (int n = 0; n < 2; n++) nsvcd_body_free(bodies[n], NULL);
}

// Work that is named is that of all, and what is proven with it is told; by default each interval
// has as much.
static void long_work_is_held(void) {
  static const size_t works[7] = {1, 30, 300, 1000, 3000, 10000, 0};
  const nsvcd_body *bodies[2] = {long_box(long_half), long_box(long_slab)};
  for (int to_contact = 0; to_contact < 2; to_contact++) {
    float low = 0;
    nsvcd_answer answer;
    long_tumble(2000, 0.5, 2e-4);
    if (to_contact) poses[1500].position[2] -= 0.03f;
    nsvcd_question q = long_question(bodies, 2000, 0, 0, 0);
    q.ask = NSVCD_ASK_FIRST;
    for (int n = 0; n < 7; n++) {
      q.work = works[n];
      answer = long_ask(&q);
      if (q.work) CHECK_LE((double)answer.work, (double)q.work + 150);
      CHECK_GE((double)answer.time.low, (double)low);
      low = answer.time.low;
      if (n == 3) CHECK(low > 0 && low < 0.7f);
      if (n < 3) CHECK_EQ(answer.verdict, NSVCD_UNDECIDED);
      if (n < 3) CHECK_EQ(answer.why, NSVCD_WHY_WORK);
    }
    CHECK_EQ(answer.verdict, to_contact ? NSVCD_HIT : NSVCD_FREE);
    // wherever in an interval the budget ends, what is before it stays proven
    low = 0;
    for (size_t work = 300; work < 3000; work += work / 16) {
      q.work = work;
      answer = long_ask(&q);
      CHECK_GE((double)answer.time.low, (double)low);
      low = answer.time.low;
    }
    q.ask = NSVCD_ASK_DISTANCE;
    for (int n = 0; n < 7; n++) {
      q.work = works[n];
      answer = long_ask(&q);
      if (q.work) CHECK_LE((double)answer.work, (double)q.work + 300);
    }
    CHECK_EQ(answer.why, NSVCD_WHY_NOTHING);
  }
  for (int n = 0; n < 2; n++) nsvcd_body_free(bodies[n], NULL);
}

// With a skin: what lies on the slab slides along it, over many poses, and a wall at the end stops
// it. What is inside at the start is.
static void long_slides(void) {
  const float wall_half[3] = {0.1f, 2, 0.3f};
  const nsvcd_body *box = long_box(long_half);
  const nsvcd_body *slab = long_box(long_slab);
  const nsvcd_body *wall = long_box(wall_half);
  const nsvcd_pose wall_at = {{0.8f, 0, 0}, {0, 0, 0, 1}};
  for (size_t n = 0; n < 700; n++) {
    memset(&poses[n], 0, sizeof poses[n]);
    poses[n].position[0] = (float)(-0.5 + 2e-3 * (double)n);
    poses[n].position[1] = n % 2 ? 0.2f : 0;
    poses[n].position[2] = 0.11f;
    poses[n].rotation[3] = 1;
  }
  nsvcd_question q = question_of(box, poses, 700, slab, NULL, NULL);
  q.ask = NSVCD_ASK_FIRST;
  q.slop = 0.001f;
  CHECK_EQ(long_ask(&q).verdict, NSVCD_FREE);
  q = question_of(box, poses, 700, wall, &wall_at, NULL);
  q.ask = NSVCD_ASK_FIRST;
  q.slop = 0.001f;
  const nsvcd_answer stopped = long_ask(&q);
  CHECK_EQ(stopped.verdict, NSVCD_HIT);
  // at x = 0.7 - 0.03
  CHECK_LE(fabs((double)stopped.time.high - 1.17 / (2e-3 * 699)), 3e-4);
  CHECK_LE((double)(stopped.time.high - stopped.time.low), 5e-4);
  for (size_t n = 0; n < 700; n++) poses[n].position[2] = 0;
  q = question_of(box, poses, 700, slab, NULL, NULL);
  const nsvcd_answer inside = long_ask(&q);
  CHECK(inside.verdict == NSVCD_HIT && inside.inside);
  nsvcd_body_free(box, NULL);
  nsvcd_body_free(slab, NULL);
  nsvcd_body_free(wall, NULL);
}

// A small ball starts on a large one, from which a skin lifts it, and shakes there for so long that
// the rest is searched by itself. It goes round the large one and comes near from below: nearer
// than it was lifted, or not.
static void long_lifts_are_kept(void) {
  const double corners[6][2] = {{0, 1.0625}, {3, 1.0625}, {3, -3}, {0, -3}, {0, -1.0665}, {0, -3}};
  const nsvcd_body *bodies[2] = {NULL, NULL};
  CHECK_EQ(nsvcd_encode_sphere(0.0625f, NULL, &bodies[0]), NSVCD_OK);
  CHECK_EQ(nsvcd_encode_sphere(1, NULL, &bodies[1]), NSVCD_OK);
  for (size_t n = 0; n < 1501; n++) {
    const double at = n < 1000 ? 0 : (double)(n - 1000) / 100;
    const size_t leg = at < 5 ? (size_t)at : 4;
    const double u = at - (double)leg;
    const double *from = corners[leg];
    const double *to = corners[leg + 1];
    memset(&poses[n], 0, sizeof poses[n]);
    poses[n].position[0] = (float)((1 - u) * from[0] + u * to[0]);
    poses[n].position[1] = n < 1000 && n % 2 ? 0.4f : 0;
    poses[n].position[2] = (float)((1 - u) * from[1] + u * to[1]);
    poses[n].rotation[3] = 1;
  }
  for (int trial = 0; trial < 2; trial++) {
    nsvcd_question q = question_of(bodies[0], poses, 1501, bodies[1], NULL, NULL);
    q.slop = trial ? 0.008f : 0.002f;
    const nsvcd_answer answer = long_ask(&q);
    CHECK_NEAR((double)answer.push_out[2], (double)q.slop, 0.01 * (double)q.slop);
    CHECK_EQ(answer.verdict, trial ? NSVCD_HIT : NSVCD_FREE);
  }
  for (int n = 0; n < 2; n++) nsvcd_body_free(bodies[n], NULL);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// An early interval that a few units for each do not settle, where all later ones are far away, is
// not forgotten, and a contact that comes later does not hide it.
static void long_open_intervals_stay(void) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(64, 64, 64));
  const nsvcd_body *bodies[2] = {long_box(long_half), long_box(long_slab)};
  for (int trial = 0; trial < 4; trial++) {
    const size_t units = 20;
    long_tumble(1000, 1.2, 2e-4);
    for (size_t n = 200; n < 1000; n++) poses[n].position[2] += 2;
    if (trial / 2) poses[998].position[2] -= 2.04f;
    nsvcd_question q = long_question(bodies, 1000, 0, 0, 0);
    if (trial % 2) q.ask = NSVCD_ASK_FIRST;
    nsvcd__query *query = nsvcd__query_open(NSVCD__FLAGS, &q, workspace);
    nsvcd__search_result result;
    nsvcd__goal goal = nsvcd__proof_begin(query);
    nsvcd__proof *p = &query->solver->p;
    p->given.work = goal.limit = goal.most = units;
    p->given.reserve = units / NSVCD__AFTER_UNRESOLVED;
    const nsvcd__finding verdict = nsvcd__prove(query->solver, &query->broad_phase, goal, &result);
    CHECK_EQ(verdict, trial / 2 ? NSVCD__FOUND_CONTACT : NSVCD__FOUND_UNDECIDED);
    CHECK_LE(nsvcd__clear_until(query->solver, &result), 0.2 * (double)goal.motion->ticks);
    if (trial / 2) CHECK_GE(result.found.tick, 0.99 * (double)goal.motion->ticks);
    CHECK_LE((double)p->work, 64 * 200);
  }
  for (int n = 0; n < 2; n++) nsvcd_body_free(bodies[n], NULL);
}

void test_long(void) {
  RUN(long_one_pose_is_low);
  RUN(long_pieces_agree);
  RUN(long_as_may_be);
  RUN(long_work_is_held);
  RUN(long_slides);
  RUN(long_lifts_are_kept);
  // from within
  RUN(long_open_intervals_stay);
}

CHECK_ALONE(test_long)
