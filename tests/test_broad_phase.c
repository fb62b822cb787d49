// The broad phase: which groups and patches meet, and when. The reference is double precision and
// written apart.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/search/search.h"
#include "../src/query/question.h"

#include "any_query.h"
#include "check.h"
#include "random_bodies.h"
#include "random_motions.h"

void test_broad_phase(void);

static nsvcd__search *work;
static nsvcd__candidate items[1 << 20], few[64];
static float swollen;  // patches swell by that share of their radii

static int deepest_first(const void *a, const void *b) {
  return nsvcd__is_shallower((const nsvcd__candidate *)a, (const nsvcd__candidate *)b) ? 1 : -1;
}

// The whole search: counts all runs, keeps the `limit` deepest in `found`, deepest first.
static void search(const nsvcd_body *moving, const nsvcd_body *fixed, nsvcd__motion *motion,
                   nsvcd__search *space, nsvcd__candidate *found, size_t limit,
                   nsvcd__candidates *kept) {
  nsvcd__cut_motion(motion, moving->extent + fixed->extent, space);
  nsvcd__plane_cache_begin(space, swollen);
  int more = nsvcd__search_begin(moving, fixed, ~(uint64_t)0, space);
  nsvcd__candidates_start(kept, found, limit);
  while (more) more = nsvcd__search_step(space, kept);
  qsort(found, kept->count, sizeof *found, deepest_first);
}

// -------------------------------------------------------------------------------- conservativeness

static int by_pair(const void *a, const void *b) {
  const nsvcd__candidate *x = (const nsvcd__candidate *)a;
  const nsvcd__candidate *y = (const nsvcd__candidate *)b;
  if (x->moving != y->moving) return x->moving < y->moving ? -1 : 1;
  if (x->fixed != y->fixed) return x->fixed < y->fixed ? -1 : 1;
  return x->t_enter < y->t_enter ? -1 : x->t_enter > y->t_enter ? 1 : 0;
}

// Is t in one of the pair's intervals? Slack: times are floats, 1e-6.
static int is_covered(const nsvcd__candidate *sorted, size_t count, size_t i, size_t j, double t) {
  size_t low = 0;
  size_t high = count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    const nsvcd__candidate *c = &sorted[middle];
    if (c->moving < i || (c->moving == i && c->fixed < j))
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < count && sorted[low].moving == i && sorted[low].fixed == j; low++) {
    if ((double)sorted[low].t_enter - 1e-6 <= t && t <= (double)sorted[low].t_exit + 1e-6) return 1;
  }
  return 0;
}

typedef struct tally {
  size_t motions, tested, overlaps, lost, free_motions, runs, runs_real, kept_wrong, parted;
} tally;

// The tips of a patch, where the fixed body sees its body; NULL: of that one itself.
static void tips_at(const nsvcd_body *body, size_t i, const oracle_pose *seen, double (*out)[3]) {
  const int8_t *from = nsvcd__group_extremes(body, i / 16) + i % 16;
  const nsvcd__spheres all = nsvcd__body_patches(body);
  const double centre[3] = {(double)all.x[i], (double)all.y[i], (double)all.z[i]};
  for (size_t k = 0; k < NSVCD__EXTREMES; k++) {
    double tip[3];
    for (size_t axis = 0; axis < 3; axis++)
      tip[axis] = centre[axis] + (double)all.r[i] / 127 * from[48 * k + 16 * axis];
    if (seen) oracle_transform(seen, tip, out[k]);
    if (!seen) memcpy(out[k], tip, sizeof tip);
  }
}

// Do the hulls of two patches' tips come as near as that, as far as 3,000 steps of Gilbert's
// algorithm can tell?
static int hulls_meet(double (*a)[3], double (*b)[3], double reach) {
  double x[3] = {a[0][0] - b[0][0], a[0][1] - b[0][1], a[0][2] - b[0][2]};
  for (int step = 0; step < 3000; step++) {
    double least = HUGE_VAL;
    double next[3] = {0, 0, 0};
    for (size_t k = 0; k < NSVCD__EXTREMES * NSVCD__EXTREMES; k++) {
      const double *p = a[k / NSVCD__EXTREMES];
      const double *q = b[k % NSVCD__EXTREMES];
      const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
      const double along = d[0] * x[0] + d[1] * x[1] + d[2] * x[2];
      if (along < least) memcpy(next, d, sizeof d);
      least = fmin(least, along);
    }
    // across x
    if (least > reach * sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])) return 0;
    double way[3];
    double square = 0;
    double back = 0;
    for (int k = 0; k < 3; k++) {
      way[k] = next[k] - x[k];
      square += way[k] * way[k];
      back -= way[k] * x[k];
    }
    if (!(back > 0) || !(square > 0)) return 1;
    const double fraction = fmin(back / square, 1);
    for (int k = 0; k < 3; k++) x[k] += fraction * way[k];
  }
  return 1;
}

// One motion: candidates against spheres sampled densely in time.
static void try_motion(const nsvcd_body *moving, const nsvcd_body *fixed, size_t count,
                       const nsvcd_pose *fixed_pose, size_t samples, tally *sum) {
  static unsigned char pair_met[NSVCD_SMALL_PATCHES][NSVCD_SMALL_PATCHES];
  nsvcd__motion motion;
  CHECK_EQ(motion_init(poses, count, fixed_pose, &motion), NSVCD_OK);
  nsvcd__candidates all, best;
  search(moving, fixed, &motion, work, items, sizeof items / sizeof *items, &all);
  CHECK_EQ(all.count, all.total);
  size_t limit = pick(1, 64);
  search(moving, fixed, &motion, work, few, limit, &best);
  CHECK_EQ(best.total, all.total);
  CHECK_EQ(best.count, all.total < limit ? all.total : limit);
  for (size_t n = 0; n < best.count; n++)
    sum->kept_wrong += memcmp(&few[n], &items[n], sizeof few[n]) != 0;
  for (size_t n = 1; n < all.count; n++) CHECK(items[n - 1].depth >= items[n].depth);
  for (size_t n = 0; n < all.count; n++) {
    const nsvcd__candidate *c = &items[n];
    CHECK(0 <= c->t_enter && c->t_enter <= c->t_least && c->t_least <= c->t_exit && c->t_exit <= 1);
    CHECK(c->moving < moving->patches && c->fixed < fixed->patches);
  }
  qsort(items, all.count, sizeof *items, by_pair);
  sum->motions++;
  sum->free_motions += all.total == 0;
  sum->runs += all.total;

  memset(pair_met, 0, sizeof pair_met);
  for (size_t n = 0; n < samples; n++) {
    // A third of the samples exactly on the poses, the rest anywhere.
    double t =
        n % 3 || count == 1 ? uniform(0, 1) : (double)pick(0, count - 1) / (double)(count - 1);
    const oracle_pose at = pose_at(poses, count, t);
    const oracle_pose seen = seen_from(fixed_pose, &at);
    for (size_t i = 0; i < moving->patches; i++) {
      double c[3] = {(double)nsvcd__body_patches(moving).x[i],
                     (double)nsvcd__body_patches(moving).y[i],
                     (double)nsvcd__body_patches(moving).z[i]};
      double p[3];
      double ri = (double)nsvcd__body_r(moving)[i];
      oracle_transform(&seen, c, p);
      for (size_t j = 0; j < fixed->patches; j++) {
        double d[3] = {p[0] - (double)nsvcd__body_patches(fixed).x[j],
                       p[1] - (double)nsvcd__body_patches(fixed).y[j],
                       p[2] - (double)nsvcd__body_patches(fixed).z[j]};
        double r = ri + (double)nsvcd__body_r(fixed)[j];
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > r * r) continue;
        sum->overlaps++;
        pair_met[i][j] = 1;
        if (is_covered(items, all.count, i, j, t)) continue;
        double own[NSVCD__EXTREMES][3];
        double other[NSVCD__EXTREMES][3];
        tips_at(moving, i, &seen, own);
        tips_at(fixed, j, NULL, other);
        const int meet = hulls_meet(own, other, r * (double)swollen);
        sum->lost += meet != 0;
        sum->parted += !meet;
      }
    }
    sum->tested += (size_t)moving->patches * fixed->patches;
  }
  for (size_t n = 0; n < all.count; n++)
    sum->runs_real += pair_met[items[n].moving][items[n].fixed];
}

static void print_tally(const char *name, const tally *t) {
  printf(
      "  %-12s %5zu motions, %9zu sphere tests, %8zu overlaps, %zu lost; %4zu free; %zu runs, %.1f "
      "%% not met, %zu parted\n",
      name, t->motions, t->tested, t->overlaps, t->lost, t->free_motions, t->runs,
      100.0 * (double)(t->runs - t->runs_real) / (double)(t->runs + (t->runs == 0)), t->parted);
}

// `turn` in radians; bodies of `size_a` and `size_b`, in a scene `away` from the origin.
static void conservative(const char *name, int motions, int kind, double turn, size_t least_count,
                         size_t most_count, double size_a, double size_b, double away) {
  tally sum;
  memset(&sum, 0, sizeof sum);
  rng_state = 12345;
  for (int n = 0; n < motions; n++) {
    const nsvcd_body *moving = random_body(pick(1, 40), size_a, n % 2 ? 0 : size_a, &blob_a_memory);
    const nsvcd_body *fixed = random_body(pick(1, 40), size_b, 0, &blob_b_memory);
    double apart = uniform(0, 1.5) * (size_a + size_b);
    double middle[3];
    nsvcd_pose fixed_pose = {{0, 0, 0}, {0, 0, 0, 1}};
    random_quat(fixed_pose.rotation);
    for (int k = 0; k < 3; k++) {
      fixed_pose.position[k] = (float)(away * uniform(0.5, 1));
      middle[k] = (double)fixed_pose.position[k] + (k == n % 3 ? apart : 0);
    }
    size_t count = pick(least_count, most_count);
    random_motion(count, kind, turn * uniform(0, 1), uniform(0, 2) * (size_a + size_b), middle);
    try_motion(moving, fixed, count, &fixed_pose, 90, &sum);
  }
  print_tally(name, &sum);
  CHECK_EQ(sum.lost, 0);
  CHECK_EQ(sum.kept_wrong, 0);
  CHECK_GE(sum.overlaps, 100);  // else nothing was tested
  CHECK(random_tips ? sum.parted >= 100 : sum.parted == 0);
}

static const double degrees = 3.14159265358979 / 180;

static void conservative_smooth(void) {
  conservative("smooth", 400, 0, 120 * degrees, 2, 40, 1, 1, 0);
}

static void conservative_wobble(void) {
  conservative("wobble", 300, 1, 120 * degrees, 1, 200, 1, 1, 0);
}

static void conservative_spin(void) {
  conservative("720 degrees", 400, 0, 720 * degrees, 9, 200, 1, 1, 0);
}

// Planes part only pairs the hulls of whose tips are apart.
static void conservative_tips(void) {
  random_tips = 1;
  conservative("tips", (int)check_many(600), 1, 120 * degrees, 1, 200, 1, 1, 0);
  conservative("tips, spin", (int)check_many(800), 0, 720 * degrees, 9, 200, 1, 0.3, 0);
  conservative("tips, far", 100, 1, 90 * degrees, 2, 20, 1, 1, 1e4);
  swollen = 0.25f;  // what swells is parted only where more than that is between the hulls
  conservative("tips, swell", (int)check_many(600), 1, 120 * degrees, 1, 200, 1, 1, 0);
  conservative("swell, spin", (int)check_many(800), 0, 720 * degrees, 9, 200, 1, 0.3, 0);
  swollen = 0;
  random_tips = 0;
}

static void conservative_tumble(void) {
  conservative("50 turns", 100, 0, 18000 * degrees, 150, 200, 1, 1, 0);
}

static void conservative_jumps(void) {
  conservative("jumps", 200, 2, 0, 1, 200, 1, 1, 0);
}

static void conservative_still(void) {
  conservative("single pose", 200, 0, 0, 1, 1, 1, 1, 0);
}

static void conservative_far(void) {
  conservative("1 km away", 200, 0, 2, 2, 40, 0.1, 0.2, 1000);
}

static void conservative_sizes(void) {
  conservative("1 : 1000", 100, 1, 2, 2, 40, 1e-3, 1, 0);
  conservative("1000 : 1", 100, 1, 2, 2, 40, 1, 1e-3, 0);
  conservative("10 km", 100, 1, 2, 2, 40, 1e4, 1e4, 0);
  conservative("micrometre", 100, 1, 2, 2, 40, 1e-6, 1e-6, 0);
}

// The bound itself: the true place of a point against its place on the chord, in double, at most
// dev apart. The points lie across the axis of rotation too, where the bound is attained: a bound
// that is a little too small fails here.
static void deviation_is_bounded(void) {
  const double paths[4] = {0, 1, 0, 0};
  const double aways[4] = {0, 0, 1000, 0};
  double most = 0;
  rng_state = 7;
  for (int trial = 0; trial < 2000; trial++) {
    size_t count = trial % 4 == 3 ? 2 : pick(1, 60);
    nsvcd_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
    double middle[3];
    random_quat(fixed.rotation);
    for (int k = 0; k < 3; k++) {
      fixed.position[k] = (float)(uniform(0.5, 1) * aways[trial % 4]);
      middle[k] = (double)fixed.position[k] + uniform(-1, 1);
    }
    random_motion(count, trial % 4 == 1 ? trial % 3 : 0, trial % 2 ? uniform(0, 12) : 0,
                  paths[trial % 4], middle);
    nsvcd__motion motion;
    CHECK_EQ(motion_init(poses, count, &fixed, &motion), NSVCD_OK);
    nsvcd__cut_motion(&motion, 1, work);
    for (int n = 0; n < 200; n++) {
      float q[4], c[3];
      random_quat(q);
      double length = sqrt((double)(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])) * 2;
      double p[3];
      double c64[3];
      double square = 0;
      for (int k = 0; k < 3; k++) {
        c[k] = (float)((double)q[k] / length);
        c64[k] = (double)c[k];
      }
      size_t s = pick(0, work->segments - 1);
      size_t l = s % NSVCD__LANES;
      double tau = uniform(0.4, 0.6);
      double start = (double)work->time[s];
      const double when = start + tau * ((double)work->time[s + 1] - start);
      const oracle_pose at = pose_at(poses, count, when);
      const oracle_pose seen = seen_from(&fixed, &at);
      oracle_transform(&seen, c64, p);
      const nsvcd__sphere point = {{c[0], c[1], c[2]}, 0};
      nsvcd__chords_in_all(work, point);
      const nsvcd__chords *chords = &work->group[s / NSVCD__LANES];
      const float x[3] = {chords->start[0][l], chords->start[1][l], chords->start[2][l]};
      const float v[3] = {chords->travel[0][l], chords->travel[1][l], chords->travel[2][l]};
      for (int k = 0; k < 3; k++) square += pow((double)x[k] + tau * (double)v[k] - p[k], 2);
      CHECK_LE(sqrt(square), chords->radius[l]);
      if (trial % 4 == 3) most = fmax(most, sqrt(square) / (double)chords->radius[l]);
    }
  }
  printf("  the bound is attained to %.4f\n", most);
  CHECK_GE(most, 0.98);
}

// With all depths equal, which pairs are kept must not depend on the order in which they were
// found.
static void ties(void) {
  memset(centres, 0, sizeof centres);
  memset(areas, 0, sizeof areas);
  memset(latents, 0, sizeof latents);
  for (size_t i = 0; i < 40; i++) radii[i] = 1;
  const nsvcd_body *a = build(40, &blob_a_memory);
  const nsvcd_body *b = build(40, &blob_b_memory);
  nsvcd_pose fixed = {{0.5f, 0, 0}, {0, 0, 0, 1}};
  nsvcd__motion motion;
  nsvcd__candidates all, best;
  poses[0] = fixed;
  poses[0].position[0] = 0;
  CHECK_EQ(motion_init(poses, 1, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 1600, &all);
  CHECK_EQ(all.total, 1600);
  for (size_t limit = 1; limit <= 64; limit++) {
    search(a, b, &motion, work, few, limit, &best);
    CHECK(memcmp(few, items, limit * sizeof *few) == 0);
    for (size_t n = 0; n < limit; n++) CHECK_EQ(few[n].moving * 40 + few[n].fixed, n);
  }
}

// A known case: two unit spheres, one passes the other at distance 1.5 along x from -5 to 5.
static void closed_form(void) {
  memset(latents, 0, sizeof latents);
  memset(areas, 0, sizeof areas);
  memset(centres, 0, sizeof centres);
  radii[0] = 1;
  const nsvcd_body *a = build(1, &blob_a_memory);
  const nsvcd_body *b = build(1, &blob_b_memory);
  nsvcd_pose fixed = {{0, 1.5f, 0}, {0, 0, 0, 1}};
  for (int n = 0; n < 2; n++) {
    poses[n] = fixed;
    poses[n].position[0] = n ? 5 : -5;
    poses[n].position[1] = 0;
  }
  nsvcd__motion motion;
  nsvcd__candidates kept;
  CHECK_EQ(motion_init(poses, 2, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 8, &kept);
  CHECK_EQ(kept.total, 1);
  CHECK_NEAR(items[0].t_enter, 0.5 - sqrt(4 - 2.25) / 10, 1e-5);
  CHECK_NEAR(items[0].t_exit, 0.5 + sqrt(4 - 2.25) / 10, 1e-5);
  CHECK_NEAR(items[0].t_least, 0.5, 1e-6);
  CHECK_NEAR(items[0].depth, 0.25, 1e-6);
  search(a, b, &motion, work, items, 0, &kept);  // only counting
  CHECK_EQ(kept.total, 1);
  fixed.position[1] = 2.001f;
  CHECK_EQ(motion_init(poses, 2, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 8, &kept);
  CHECK_EQ(kept.total, 0);
}

// One pair that overlaps throughout a full turn: runs follow each other without a hole, none turns
// over 45 degrees.
static void runs_are_cut(void) {
  memset(latents, 0, sizeof latents);
  memset(areas, 0, sizeof areas);
  memset(centres, 0, sizeof centres);
  radii[0] = 1;
  const nsvcd_body *a = build(1, &blob_a_memory);
  const nsvcd_body *b = build(1, &blob_b_memory);
  const double middle[3] = {0.1, 0, 0};
  nsvcd_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
  nsvcd__motion motion;
  nsvcd__candidates kept;
  random_motion(17, 0, 360 * degrees, 0, middle);
  CHECK_EQ(motion_init(poses, 17, &fixed, &motion), NSVCD_OK);
  search(a, b, &motion, work, items, 100, &kept);
  qsort(items, kept.count, sizeof *items, by_pair);
  CHECK_GE(kept.count, 8);
  CHECK_LE(kept.count, 17);
  CHECK_EQ(items[0].t_enter, 0);
  CHECK_EQ(items[kept.count - 1].t_exit, 1);
  for (size_t n = 0; n < kept.count; n++) {
    CHECK_LE((items[n].t_exit - items[n].t_enter) * 360, 46);
    if (n > 0) CHECK_EQ(items[n].t_enter, items[n - 1].t_exit);
  }
}

void test_broad_phase(void) {
  work = &any_query()->broad_phase;
  RUN(closed_form);
  RUN(ties);
  RUN(deviation_is_bounded);
  RUN(runs_are_cut);
  RUN(conservative_smooth);
  RUN(conservative_wobble);
  RUN(conservative_spin);
  RUN(conservative_tips);
  RUN(conservative_tumble);
  RUN(conservative_jumps);
  RUN(conservative_still);
  RUN(conservative_far);
  RUN(conservative_sizes);
}

CHECK_ALONE(test_broad_phase)
