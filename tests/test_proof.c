// The proof, attacked: every certificate replayed in double at other times and points than it was
// made from, poses at which triangles cross, witnesses, containment, limits, and scenes that are
// hard to get right. TEST_ALONE: with a main of its own. TEST_MANY=5 in the environment: as many
// times more crossings.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "proof_ears.h"
#include "../src/ground/strings.h"
#include "../src/body/trust.h"
#include "../src/body/encode.h"
#include "../src/query/question.h"

#include "any_query.h"
#include "question_of.h"
#include "check.h"
#include "proof_scene.h"
#include "../examples/scenery/status_of.h"

void test_proof(void);

// A question, and what came of it.
typedef struct attack {
  const proof_body *moving, *fixed;
  proof_motion motion;
  nsvcd_answer answer;
} attack;

static nsvcd_mover proof_mover(const proof_body *b, const proof_track *track) {
  nsvcd_mover mover;
  mover.body = b->body;
  mover.poses = track->raw;
  mover.times = track->timed ? track->times : NULL;
  mover.count = track->count;
  mover.scale = track->scale;
  memcpy(mover.pivot, track->pivot, sizeof mover.pivot);
  return mover;
}
static nsvcd_question proof_question(const attack *a, const nsvcd_question *options) {
  nsvcd_question question = *options;
  question.a = proof_mover(a->moving, &a->motion.moving);
  question.b = proof_mover(a->fixed, &a->motion.fixed);
  return question;
}

// Takes as the fixed body the one that the library takes, so that certificates are about moving and
// fixed as they are here.
static void proof_settle_sides(attack *a) {
  const nsvcd_question options = proof_options();
  const nsvcd_question question = proof_question(a, &options);
  if (!nsvcd__is_swapped(&question.a, &question.b)) return;
  const proof_body *moving = a->moving;
  const proof_track track = a->motion.moving;
  a->moving = a->fixed;
  a->fixed = moving;
  a->motion.moving = a->motion.fixed;
  a->motion.fixed = track;
}

static nsvcd_result proof_ask_with(attack *a, const nsvcd_question *options) {
  heard.count = heard.left_out = 0;
  proof_settle_sides(a);
  const nsvcd_question question = proof_question(a, options);
  return nsvcd_sweep(&question, proof_workspace(), nsvcd_sweep_workspace_size(NULL), &a->answer);
}
static void proof_ask_first(nsvcd_question *options, float to_time) {
  options->ask = NSVCD_ASK_FIRST;
  options->to_time = to_time;
}
static void proof_ask_distance(nsvcd_question *options, float to) {
  options->ask = NSVCD_ASK_DISTANCE;
  options->to = to;
}
static void proof_ask(attack *a) {
  const nsvcd_question options = proof_options();
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
}

// -------------------------------------------------------------------------------------------------
// scenes

static void proof_turned(const double *turn, const oracle_pose *pose, const double *pivot,
                         oracle_pose *out) {
  double m[9], d[3];
  oracle_matrix(turn, m);
  oracle_sub(pose->position, pivot, d);
  oracle_rotate(m, d, out->position);
  for (int k = 0; k < 3; k++) out->position[k] += pivot[k];
  oracle_quat_mul(turn, pose->rotation, out->rotation);
  oracle_quat_normalize(out->rotation);
}

static void proof_random_rotation(shapes_rng *rng, int aligned, double *q) {
  const double half = sqrt(0.5);
  shapes_quaternion(rng, q);
  if (!aligned) return;
  const int axis = shapes_pick(rng, 4);
  for (int k = 0; k < 4; k++) q[k] = 0;
  q[3] = axis == 3 ? 1 : half;
  if (axis < 3) q[axis] = half;
}

// A pose of the moving body with its surface `gap` from the fixed one's; `point`: where, `away`:
// the way out. 0 if none is found.
static int proof_near_contact(shapes_rng *rng, const attack *a, const oracle_pose *fixed,
                              double gap, oracle_pose *pose, double *point, double *away) {
  const double reach = a->moving->size + a->fixed->size;
  double q[4], on_moving[3], on_fixed[3], d[3];
  proof_random_rotation(rng, shapes_pick(rng, 2), q);
  oracle_quat_mul(fixed->rotation, q, pose->rotation);
  for (int trial = 0; trial < 10; trial++) {
    const double far = shapes_uniform(rng, 0, 1.2) * reach;
    shapes_direction(rng, d);
    for (int k = 0; k < 3; k++) pose->position[k] = fixed->position[k] + far * d[k];
    const double distance =
        oracle_distance(&a->moving->oracle, pose, &a->fixed->oracle, fixed, on_moving, on_fixed);
    if (distance <= 1e-6 * reach) continue;
    for (int k = 0; k < 3; k++) {
      away[k] = (on_moving[k] - on_fixed[k]) / distance;
      pose->position[k] -= (distance - gap) * away[k];
      point[k] = on_fixed[k];
    }
    return 1;
  }
  return 0;
}

// A motion that passes the pose at some time.
static void proof_motion_past(shapes_rng *rng, const oracle_pose *pose, const double *point,
                              const double *away, double size, double angle, size_t count,
                              oracle_pose *poses) {
  const double when = shapes_uniform(rng, 0.1, 0.9);
  const double lift = shapes_pick(rng, 2) ? 0 : shapes_uniform(rng, 0, 1) * size;
  const double farther = shapes_pick(rng, 8) ? 1 : fmin(300, 5e5 / size);  // some come from afar
  const double slide =
      shapes_pick(rng, 2) ? 0 : shapes_uniform(rng, 0, 1.5) * size * fmax(farther, 1);
  const int about_contact = shapes_pick(rng, 2);
  double axis[3], along[3], turn[4];
  shapes_direction(rng, axis);
  shapes_direction(rng, along);
  if (shapes_pick(rng, 2)) memcpy(axis, away, sizeof axis);
  const double inwards = oracle_dot(along, away);
  for (int k = 0; k < 3; k++) along[k] -= inwards * away[k];
  for (size_t n = 0; n < count; n++) {
    const double s = count > 1 ? (double)n / (double)(count - 1) - when : 0;
    oracle_axis_angle(axis, angle * s, turn);
    proof_turned(turn, pose, about_contact ? point : pose->position, &poses[n]);
    for (int k = 0; k < 3; k++)
      poses[n].position[k] += fabs(s) * lift * away[k] + s * slide * along[k];
  }
}

static void proof_any_two(shapes_rng *rng, attack *a) {
  a->moving = proof_shared(0, (size_t)shapes_pick(rng, MAKES));
  a->fixed = proof_shared(0, (size_t)shapes_pick(rng, MAKES));
}

// A scene near contact. gap: of the sum of both sizes.
static int proof_scene(shapes_rng *rng, attack *a, double gap, double offset) {
  static const size_t counts[6] = {1, 2, 2, 17, 33, 65};
  static const double angles[8] = {0,   0.02,          0.2,           1,
                                   2.5, 2 * SHAPES_PI, 3 * SHAPES_PI, 4 * SHAPES_PI};
  const double size = a->moving->size + a->fixed->size;
  const size_t count = counts[shapes_pick(rng, 6)];
  const double angle = angles[shapes_pick(rng, count > 5 ? 8 : 5)];
  oracle_pose fixed, pose, poses[PROOF_POSES];
  double point[3], away[3];
  shapes_quaternion(rng, fixed.rotation);
  if (shapes_pick(rng, 3) == 0) proof_random_rotation(rng, 1, fixed.rotation);
  for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(rng, -1, 1) * offset * size;
  if (!proof_near_contact(rng, a, &fixed, gap * size, &pose, point, away)) return 0;
  proof_motion_past(rng, &pose, point, away, size, angle, count, poses);
  proof_motion_set(&a->motion, poses, count, &fixed);
  proof_set_times(*rng, &a->motion.moving);
  proof_set_pivot(*rng, &a->motion.moving);
  return 1;
}

// The moving body's scale over that of the fixed one, and the size of both, in the fixed mesh's
// units.
static double proof_ratio(const attack *a) {
  return (double)a->motion.moving.scale / (double)a->motion.fixed.scale;
}
static double proof_size(const attack *a) {
  return proof_ratio(a) * a->moving->size + a->fixed->size;
}

// Moves both bodies along: what one sees of the other stays what it is at its own poses, and, but
// for what slerps do between these, at the times between. Now and then the other one has fewer
// poses, or more.
static void proof_carry(shapes_rng *rng, attack *a, double angle, double way) {
  static const size_t others[4] = {2, 3, 7, 33};
  proof_track *moving = &a->motion.moving;
  proof_track *fixed = &a->motion.fixed;
  const size_t count = shapes_pick(rng, 3) ? moving->count : others[shapes_pick(rng, 4)];
  const oracle_pose rest = fixed->poses[0];
  oracle_pose carried[PROOF_POSES], poses[PROOF_POSES];
  double axis[3], along[3];
  if (moving->count < 2 || fixed->count > 1) return;
  shapes_direction(rng, axis);
  shapes_direction(rng, along);
  for (int side = 0; side < 2; side++) {
    const size_t n = side ? count : moving->count;
    for (size_t i = 0; i < n; i++) {
      const double t = (double)i / (double)(n - 1);
      oracle_pose common;
      oracle_axis_angle(axis, angle * t, common.rotation);
      for (int k = 0; k < 3; k++) common.position[k] = way * t * along[k];
      if (side) carried[i] = oracle_compose(&common, &rest);
      if (!side) poses[i] = oracle_compose(&common, &moving->poses[i]);
    }
  }
  const float scales[2] = {moving->scale, fixed->scale};
  proof_track_set(moving, poses, moving->count);
  proof_track_set(fixed, carried, count);
  moving->scale = scales[0];
  fixed->scale = scales[1];
}

// The same, and each in its own time, now and then.
static void proof_carry_unevenly(shapes_rng *rng, attack *a, double angle, double way) {
  proof_carry(rng, a, angle, way);
  shapes_rng aside = *rng;
  proof_set_times(aside, &a->motion.moving);
  aside.state++;
  proof_set_times(aside, &a->motion.fixed);
  aside.state++;
  proof_set_pivot(aside, &a->motion.moving);
  aside.state++;
  proof_set_pivot(aside, &a->motion.fixed);
}

// -------------------------------------------------------------------------------------
// certificates, replayed

typedef struct replay {
  size_t records, evaluations, wrong;
  size_t pairs, bare, nearest;  // coverage: pairs of patches at a time; those that nothing covers
  size_t verdicts[6];
  double worst;  // gap over what is allowed, where wrong
} replay;

// Of each kind of what separates: how much was looked at, and the least gap, of the sum of both
// sizes.
static struct {
  size_t count;
  double least;
} looked_at[HEARD_KINDS];

// normal . (x(t) - y), least over the points of both sides.
static double proof_gap(const double *normal, const proof_place *at, const double (*x)[3],
                        size_t xs, const double (*y)[3], size_t ys) {
  double turned[3];
  double lowest = DBL_MAX;
  double highest = -DBL_MAX;
  oracle_rotate_back(at->matrix, normal, turned);
  for (size_t i = 0; i < xs; i++) lowest = fmin(lowest, oracle_dot(turned, x[i]));
  for (size_t i = 0; i < ys; i++) highest = fmax(highest, oracle_dot(normal, y[i]));
  return lowest + oracle_dot(normal, at->position) - highest;
}

// By how much a plane with this normal parts, at t, what it has to: all that two patches hold, or
// two triangles. A piece of a triangle is stored in integers, and the library parts the triangle:
// what the piece is off is allowed.
static double proof_plane_gap(const attack *a, const proof_record *r, const double *normal,
                              double t) {
  const proof_patch *p = &a->moving->patches[r->i];
  const proof_patch *q = &a->fixed->patches[r->j];
  const proof_place at = proof_place_at(&a->motion, t);
  const double length = oracle_length(normal);
  if (!(length > 0)) return -DBL_MAX;
  if (r->kind < HEARD_BLOCKS)
    return proof_gap(normal, &at, (const double(*)[3])p->pool, p->pool_count,
                     (const double(*)[3])q->pool, q->pool_count) /
           length;
  const proof_listing *x = &a->moving->listings[r->a];
  const proof_listing *y = &a->fixed->listings[r->b];
  const double gap =
      proof_gap(normal, &at, (const double(*)[3])x->corners, 3, (const double(*)[3])y->corners, 3);
  return gap / length + (x->whole ? 0 : proof_ratio(a) * p->quantum) + (y->whole ? 0 : q->quantum);
}

// Does one plane of those that the certificate names, or an axis, hold at all of the times?
static int proof_is_true(const attack *a, const proof_record *r, const double *times, int count,
                         replay *sum) {
  static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int boxes = r->kind == HEARD_BLOCKS || r->kind == HEARD_ROWS;
  double best = -DBL_MAX;
  if (r->kind == HEARD_RESOLVED) return 1;
  if (r->kind < HEARD_BLOCKS &&
      (!a->moving->patches[r->i].pool_count || !a->fixed->patches[r->j].pool_count))
    return 1;
  for (int n = 0; n < (boxes ? 10 : 4) && !(best > 0); n++) {
    const double *from = n < 4 ? &r->normals[n / 2].x : axes[n / 2 - 2];
    double normal[3], least = DBL_MAX;
    for (int k = 0; k < 3; k++) normal[k] = n % 2 ? -from[k] : from[k];
    for (int k = 0; k < count && least > best; k++)
      least = fmin(least, proof_plane_gap(a, r, normal, times[k]));
    best = fmax(best, least);
  }
  sum->evaluations++;
  best /= proof_size(a);
  looked_at[r->kind].least = fmin(looked_at[r->kind].count++ ? looked_at[r->kind].least : 1, best);
  if (best > 0) return 1;
  sum->worst = fmin(sum->worst, best);
  return 0;
}

static void proof_replay_records(const attack *a, shapes_rng *rng, replay *sum) {
  const size_t most = 12000;
  const size_t stride = heard.count / most + 1;
  sum->records += heard.count;
  for (size_t n = shapes_next(rng) % stride; n < heard.count; n += stride) {
    const proof_record *r = &heard.items[n];
    const double random = shapes_uniform(rng, 0, 1);
    const double middle = 0.5 * (r->start + r->end);
    const double times[4] = {middle, r->start + random * (r->end - r->start), r->start, r->end};
    sum->wrong += !proof_is_true(a, r, times, r->kind < HEARD_BLOCKS ? 4 : 2, sum);
  }
}

static int proof_compare(const void *pa, const void *pb) {
  const proof_record *a = (const proof_record *)pa;
  const proof_record *b = (const proof_record *)pb;
  if (a->i != b->i) return a->i < b->i ? -1 : 1;
  return (a->j > b->j) - (a->j < b->j);
}
// Where the certificates of pair (i, j) begin, in order: (patches, patches) + 1.
static const size_t *proof_index(const attack *a) {
  static size_t *first, room;
  const size_t pairs = a->moving->count * a->fixed->count;
  qsort(heard.items, heard.count, sizeof *heard.items, proof_compare);
  if (room < pairs + 1) {
    free(first);
    first = (size_t *)malloc((pairs + 1) * sizeof *first);
    room = pairs + 1;
  }
  if (!first) exit(1);
  size_t n = 0;
  for (size_t pair = 0; pair <= pairs; pair++) {
    while (n < heard.count && heard.items[n].i * a->fixed->count + heard.items[n].j < pair) n++;
    first[pair] = n;
  }
  return first;
}

// Are all pairs of listed triangles of two patches covered at t?
static int proof_triangles_covered(const attack *a, size_t i, size_t j, const proof_record *records,
                                   size_t count, double t) {
  const proof_patch *p = &a->moving->patches[i];
  const proof_patch *q = &a->fixed->patches[j];
  const size_t wide = q->end - q->first;
  const size_t all = (p->end - p->first) * wide;
  size_t covered = 0;
  unsigned char *seen = (unsigned char *)calloc(all + 1, 1);
  if (!seen) exit(1);
  for (size_t n = 0; n < count; n++) {
    const proof_record *r = &records[n];
    if (r->kind < HEARD_BLOCKS || t < r->start || t > r->end) continue;
    unsigned char *mark = &seen[(r->a - p->first) * wide + (r->b - q->first)];
    covered += !*mark;
    *mark = 1;
  }
  free(seen);
  return covered == all;
}

static int proof_is_covered(const attack *a, const size_t *first, size_t i, size_t j, double t) {
  const size_t pair = i * a->fixed->count + j;
  const proof_record *records = heard.items + first[pair];
  const size_t count = first[pair + 1] - first[pair];
  for (size_t n = 0; n < count; n++) {
    const proof_record *r = &records[n];
    if (r->kind < HEARD_BLOCKS && t >= r->start && t <= r->end) return 1;
  }
  return proof_triangles_covered(a, i, j, records, count, t);
}

// Do two patches' balls overlap, and so do all that are over them? at: of the moving one.
static int proof_balls_meet(const attack *a, const proof_place *at, const proof_patch *p,
                            const proof_patch *q) {
  for (int n = 0; n < 9; n++) {
    const double *moving = n % 3 ? p->above[n % 3 - 1] : p->centre;
    const double *fixed = n / 3 ? q->above[n / 3 - 1] : q->centre;
    const double radius = n % 3 ? moving[3] : p->radius;
    const double other = n / 3 ? fixed[3] : q->radius;
    const double reach = (proof_ratio(a) * radius + other) * (1 - 1e-9);
    double centre[3], d[3];
    proof_apply(at, moving, centre);
    oracle_sub(centre, fixed, d);
    if (oracle_dot(d, d) >= reach * reach) return 0;
  }
  return 1;
}

// All pairs of patches whose balls overlap at t.
static void proof_cover_at(const attack *a, const size_t *first, double t, replay *sum) {
  const proof_place at = proof_place_at(&a->motion, t);
  for (size_t i = 0; i < a->moving->count; i++) {
    const proof_patch *p = &a->moving->patches[i];
    for (size_t j = 0; j < a->fixed->count && p->hull_count; j++) {
      const proof_patch *q = &a->fixed->patches[j];
      if (!q->hull_count || !proof_balls_meet(a, &at, p, q)) continue;
      sum->pairs++;
      sum->bare += !proof_is_covered(a, first, i, j, t);
    }
  }
}

// The points of both surfaces that are nearest to each other at t: they are apart, and so says each
// plane on them.
static void proof_nearest_at(const attack *a, const size_t *first, double t, replay *sum) {
  // the oracle's meshes have no scale
  if (a->motion.moving.scale < 1 || a->motion.moving.scale > 1) return;
  if (a->motion.fixed.scale < 1 || a->motion.fixed.scale > 1) return;
  const proof_place at = proof_place_at(&a->motion, t);
  const oracle_pose pose = proof_pose_at(&a->motion.moving, t);
  const oracle_pose fixed = proof_pose_at(&a->motion.fixed, t);
  oracle_search s;
  double x[3], d[3];
  oracle_search_begin(&s, &a->fixed->oracle, &a->moving->oracle);
  const double distance = oracle_search_run(&s, &fixed, &pose, DBL_MAX);
  CHECK_GE(distance, 1e-300);
  oracle_sub(s.on_b, at.position, d);
  oracle_rotate_back(at.matrix, d, x);
  for (size_t i = 0; i < a->moving->count; i++) {
    if (!a->moving->patches[i].hull_count || proof_holds(&a->moving->patches[i], x) != 1) continue;
    for (size_t j = 0; j < a->fixed->count; j++) {
      if (!a->fixed->patches[j].hull_count || proof_holds(&a->fixed->patches[j], s.on_a) != 1)
        continue;
      const size_t pair = i * a->fixed->count + j;
      sum->nearest++;
      for (size_t n = first[pair]; n < first[pair + 1]; n++) {
        const proof_record *r = &heard.items[n];
        if (r->kind != HEARD_HULLS && r->kind != HEARD_AGAIN) continue;
        if (t < r->start || t > r->end) continue;
        const double gap = proof_gap(&r->normals[0].x, &at, (const double(*)[3])x, 1,
                                     (const double(*)[3])s.on_a, 1);
        sum->wrong += !(gap > 0);
      }
    }
  }
}

static void proof_check_witness(const attack *a);

static void proof_replay(attack *a, shapes_rng *rng, replay *sum) {
  proof_ask(a);
  sum->verdicts[status_of(&a->answer)]++;
  proof_replay_records(a, rng, sum);
  if (status_of(&a->answer) == STATUS_WITNESS) proof_check_witness(a);
  if (a->answer.verdict != NSVCD_FREE || heard.left_out) return;
  const size_t *first = proof_index(a);
  const double arcs = a->motion.moving.count > 1 ? (double)(a->motion.moving.count - 1) : 1;
  for (int k = 0; k < 6; k++) {
    double t = shapes_uniform(rng, 0, 1);
    if (k == 0) t = 0;
    if (k == 1) t = 1;
    if (k == 2) t = floor(t * arcs) / arcs;
    if (k == 3 && heard.count) t = heard.items[shapes_next(rng) % heard.count].end;
    proof_cover_at(a, first, t, sum);
    proof_nearest_at(a, first, t, sum);
  }
}

// Each kind has separated something, and some of it by little.
static void proof_check_kinds(void) {
  static const char *const names[HEARD_RESOLVED] = {
      "slabs of groups",    "slabs", "hulls", "held again", "blocks", "rows", "last",
      "all of two patches", "pairs"};
  for (int k = 0; k < HEARD_RESOLVED; k++) {
    printf("  %s: %zu looked at, the least gap %.2g\n", names[k], looked_at[k].count,
           looked_at[k].least);
    CHECK_GE(looked_at[k].count, 20);
    CHECK_LE(looked_at[k].least, 2e-3);
  }
}

static void proof_report(const char *name, const replay *sum) {
  printf(
      "  %s: free %zu, inside %zu, witness %zu, undecided %zu; %zu certificates, %zu looked at, "
      "%zu wrong (%.3g); "
      "%zu pairs of patches, %zu bare; %zu nearest\n",
      name, sum->verdicts[STATUS_CERTIFIED_FREE], sum->verdicts[STATUS_INSIDE],
      sum->verdicts[STATUS_WITNESS], sum->verdicts[STATUS_UNDECIDED], sum->records,
      sum->evaluations, sum->wrong, sum->worst, sum->pairs, sum->bare, sum->nearest);
  CHECK_EQ(sum->wrong, 0);
  CHECK_EQ(sum->bare, 0);
}

// -------------------------------------------------------------------------------------------------
// witnesses

static struct {
  size_t count, supports;
  double worst_gap;           // over what is allowed
  size_t no_normal, leaving;  // normals that are 0, and that are along the motion
} witnesses;

// No point of the body moves by more than this in an interval of time about t.
static double proof_track_speed(const proof_track *m, double size, double t, double interval) {
  if (m->count < 2) return 0;
  double fastest = 0;
  for (int side = -1; side <= 1; side++) {
    const size_t k = proof_pose_before(m, t + side * interval);
    const double duration = proof_time_of(m, k + 1) - proof_time_of(m, k);
    const double way = proof_track_way(m, k, size * (double)m->scale);
    fastest = fmax(fastest, way / duration);
  }
  return fastest * interval;
}
static double proof_speed_bound(const attack *a, double t, double interval) {
  return proof_track_speed(&a->motion.moving, a->moving->size, t, interval) +
         proof_track_speed(&a->motion.fixed, a->fixed->size, t, interval);
}

static oracle_triangle proof_world_triangle(const proof_body *b, size_t triangle,
                                            const oracle_pose *pose, double scale) {
  oracle_triangle out;
  double corners[3][3];
  proof_corners(b, triangle, corners);
  for (int k = 0; k < 9; k++) corners[k / 3][k % 3] *= scale;
  for (int k = 0; k < 3; k++) oracle_transform(pose, corners[k], out.v[k]);
  oracle_triangle_normal(&out);
  return out;
}
static oracle_triangle proof_point_triangle(const float *point) {
  oracle_triangle out;
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 3; i++) out.v[k][i] = (double)point[i];
    out.normal[k] = 0;
  }
  return out;
}
static double proof_triangle_distance(const oracle_triangle *a, const oracle_triangle *b) {
  double x[3], y[3];
  return sqrt(oracle_triangles(a, b, DBL_MAX, x, y));
}

// By how much the moving point that is at x at a time has moved in a little time before, and the
// fixed one's has not. 0 if a pose is reached in it.
static int proof_moved(const attack *a, double t, const double *x, double little, double *moved) {
  for (int n = 0; n < 2; n++) {
    const proof_track *track = n ? &a->motion.fixed : &a->motion.moving;
    double m[9], off[3], own[3], before[3];
    if (track->count < 2) continue;
    if (proof_pose_before(track, t - 2 * little) != proof_pose_before(track, t + little)) return 0;
    const oracle_pose now = proof_pose_at(track, t);
    const oracle_pose then = proof_pose_at(track, t - little);
    oracle_matrix(now.rotation, m);
    oracle_sub(x, now.position, off);
    oracle_rotate_back(m, off, own);
    oracle_transform(&then, own, before);
    for (int k = 0; k < 3; k++) moved[k] += (n ? -1 : 1) * (x[k] - before[k]);
  }
  return 1;
}

// The normal of triangles that meet is against the motion of the point, unless these have been in
// touch from the start, as far as its speed tells.
static void proof_check_normal(const attack *a, const oracle_triangle *x, const oracle_triangle *y,
                               double allowed, double noise) {
  const nsvcd_contact *c = &a->answer.nearest;
  const double normal[3] = {(double)c->normal[0], (double)c->normal[1], (double)c->normal[2]};
  const double point[3] = {(double)c->point[0], (double)c->point[1], (double)c->point[2]};
  const double little = 1e-6;
  const double t = (double)c->time;
  double moved[3] = {0, 0, 0};
  witnesses.no_normal += oracle_length(normal) < 0.5;
  CHECK(oracle_length(normal) < 1e-6 || fabs(oracle_length(normal) - 1) < 1e-6);
  if (t < 4 * little || !proof_moved(a, t, point, little, moved)) return;
  if (oracle_dot(moved, normal) <= 1e-3 * oracle_length(moved) + noise) return;
  oracle_triangle back = *x;
  witnesses.leaving++;
  for (int k = 0; k < 9; k++) back.v[k / 3][k % 3] -= t / little * moved[k % 3];
  CHECK_LE(proof_triangle_distance(&back, y), allowed);
}

// The triangles that an answer names meet then and there, or, where they are in doubt, come as near
// as it says.
static void proof_check_triangles(const attack *a, int meets) {
  const nsvcd_answer *w = &a->answer;
  CHECK(w->nearest.triangle_a < a->moving->triangles &&
        w->nearest.triangle_b < a->fixed->triangles);
  CHECK(w->nearest.time >= w->time.low && w->nearest.time <= 1);
  if (w->nearest.triangle_a >= a->moving->triangles || w->nearest.triangle_b >= a->fixed->triangles)
    return;
  const double scale = (double)a->motion.moving.scale;
  const double fixed_scale = (double)a->motion.fixed.scale;
  const oracle_pose pose = proof_pose_at(&a->motion.moving, (double)w->nearest.time);
  const oracle_pose fixed = proof_pose_at(&a->motion.fixed, (double)w->nearest.time);
  const oracle_triangle x = proof_world_triangle(a->moving, w->nearest.triangle_a, &pose, scale);
  const oracle_triangle y =
      proof_world_triangle(a->fixed, w->nearest.triangle_b, &fixed, fixed_scale);
  const oracle_triangle point = proof_point_triangle(w->nearest.point);
  const double far = oracle_length(fixed.position) + oracle_length(pose.position);
  const double size = scale * a->moving->size + fixed_scale * a->fixed->size;
  const double quantum_x = scale * (double)nsvcd_body_describe(a->moving->body).quantization_error;
  const double quantum_y =
      fixed_scale * (double)nsvcd_body_describe(a->fixed->body).quantization_error;
  // A unit in the last place of a float in [0.5, 1]: times of contacts are rounded up.
  const double moved = proof_speed_bound(a, (double)w->nearest.time, 6e-8) + 1e-12 * (size + far);
  const double rounded = 6e-8 * (oracle_length(point.v[0])) + 1e-30;
  const double far_off = meets ? quantum_x + quantum_y : (double)w->distance.high;
  const double allowed = far_off + moved;
  const double gap = proof_triangle_distance(&x, &y);
  CHECK_LE(gap, allowed);
  CHECK_LE(proof_triangle_distance(&x, &point), (meets ? quantum_x : allowed) + moved + rounded);
  const double fixed_moved =
      proof_track_speed(&a->motion.fixed, a->fixed->size, (double)w->nearest.time, 6e-8) +
      1e-12 * (size + far);
  CHECK_LE(proof_triangle_distance(&y, &point), quantum_y + rounded + fixed_moved);
  if (!meets) return;
  witnesses.count++;
  witnesses.worst_gap = fmax(witnesses.worst_gap, gap / allowed);
  proof_check_normal(a, &x, &y, allowed, 1e-14 * (size + far));
}

static void proof_check_witness(const attack *a) {
  const nsvcd_answer *w = &a->answer;
  CHECK_EQ(w->verdict, NSVCD_HIT);
  CHECK_EQ(w->time.high, w->nearest.time);
  CHECK_EQ(w->contact_count, 1);
  CHECK_EQ(memcmp(&w->contacts[0], &w->nearest, sizeof w->nearest), 0);
  proof_check_triangles(a, 1);
}

// Of a manifold: each point is where its triangles are, as near to each other as it says, and that
// is no more than what was asked for. All else is as without.
static void proof_check_manifold(attack *a, const nsvcd_question *asked) {
  const nsvcd_answer alone = a->answer;
  nsvcd_question question = *asked;
  question.manifold = 1;
  CHECK_EQ(proof_ask_with(a, &question), NSVCD_OK);
  const nsvcd_answer *w = &a->answer;
  const double t = (double)w->time.high;
  const oracle_pose pose = proof_pose_at(&a->motion.moving, t);
  const oracle_pose fixed = proof_pose_at(&a->motion.fixed, t);
  const double scales[2] = {(double)a->motion.moving.scale, (double)a->motion.fixed.scale};
  const double sizes[2] = {scales[0] * a->moving->size, scales[1] * a->fixed->size};
  const double far = oracle_length(fixed.position) + oracle_length(pose.position);
  const double moved = proof_speed_bound(a, t, 3e-8) + 1e-6 * (sizes[0] + sizes[1]) + 1e-7 * far;
  double radii[2], quanta = 0;
  for (int k = 0; k < 2; k++) {
    const nsvcd_body_facts facts = nsvcd_body_describe(k ? a->fixed->body : a->moving->body);
    radii[k] = scales[k] * (double)facts.radius;
    quanta += scales[k] * (double)facts.quantization_error;
  }
  const double epsilon = quanta + moved;
  const double to = (double)NSVCD_DEFAULT_TO * fmin(radii[0], radii[1]);
  const double reach = 1.001 * fmax(to, 4 * quanta) + epsilon;
  CHECK_EQ(memcmp(&alone.nearest, &w->nearest, sizeof w->nearest), 0);
  CHECK_EQ(memcmp(&alone.safe, &w->safe, sizeof w->safe), 0);
  CHECK_EQ(memcmp(&alone.time, &w->time, sizeof w->time), 0);
  CHECK(w->contact_count >= 1 && w->contact_count <= NSVCD_MAX_CONTACTS);
  for (size_t n = 0; n < w->contact_count; n++) {
    const nsvcd_contact *c = &w->contacts[n];
    const oracle_triangle x = proof_world_triangle(a->moving, c->triangle_a, &pose, scales[0]);
    const oracle_triangle y = proof_world_triangle(a->fixed, c->triangle_b, &fixed, scales[1]);
    const oracle_triangle point = proof_point_triangle(c->point);
    const double off[2] = {proof_triangle_distance(&x, &point),
                           proof_triangle_distance(&y, &point)};
    const double normal[3] = {(double)c->normal[0], (double)c->normal[1], (double)c->normal[2]};
    if (w->contact_count > 1) CHECK_NEAR(oracle_length(normal), 1, 1e-6);
    CHECK_LE(fmin(off[0], off[1]), epsilon);
    CHECK_LE(fmax(off[0], off[1]), reach);
    CHECK_LE(c->gap, reach);
    CHECK_LE(proof_triangle_distance(&x, &y), (double)c->gap + reach);
    if (n > 0) CHECK(c->id > c[-1].id);
  }
  witnesses.supports += w->contact_count;
  a->answer = alone;
}

// -------------------------------------------------------------------------------------------------
// crossings

// Where an edge of triangle a passes through the inside of b, clear of its edges and with both ends
// clear of its plane.
static int proof_edge_crosses(double a[3][3], double b[3][3], double clear, double *point) {
  double e0[3], e1[3], n[3];
  oracle_sub(b[1], b[0], e0);
  oracle_sub(b[2], b[0], e1);
  oracle_cross(e0, e1, n);
  const double length = oracle_length(n);
  if (!(length > 0)) return 0;
  for (int k = 0; k < 3; k++) {
    double from[3];
    double to[3];
    double least = DBL_MAX;
    oracle_sub(a[k], b[0], from);
    oracle_sub(a[(k + 1) % 3], b[0], to);
    const double h0 = oracle_dot(n, from) / length;
    const double h1 = oracle_dot(n, to) / length;
    if (h0 * h1 >= 0 || fabs(h0) < clear || fabs(h1) < clear) continue;
    for (int i = 0; i < 3; i++) point[i] = a[k][i] + h0 / (h0 - h1) * (a[(k + 1) % 3][i] - a[k][i]);
    for (int i = 0; i < 3; i++) {
      double edge[3], d[3], c[3];
      oracle_sub(b[(i + 1) % 3], b[i], edge);
      oracle_sub(point, b[i], d);
      oracle_cross(edge, d, c);
      least = fmin(least, oracle_dot(n, c) / length / fmax(oracle_length(edge), 1e-300));
    }
    if (least >= clear) return 1;
  }
  return 0;
}

// Do the triangles cross properly at this time? Then point is where, fixed frame.
static int proof_cross_at(const attack *a, size_t x, size_t y, double t, double *point) {
  const proof_place at = proof_place_at(&a->motion, t);
  const double clear = 1e-11 * (a->moving->size + a->fixed->size);
  double corners[3][3], posed[3][3], other[3][3];
  proof_corners(a->moving, x, corners);
  proof_corners(a->fixed, y, other);
  for (int k = 0; k < 3; k++) proof_apply(&at, corners[k], posed[k]);
  return proof_edge_crosses(posed, other, clear, point) ||
         proof_edge_crosses(other, posed, clear, point);
}

// A pose of the moving body, seen from the fixed one, at which triangle a meets b: a corner of a is
// `depth` beyond a point of b, on the side on which a's other corners are not. 0 if there is no
// such thing.
static int proof_corner_through(shapes_rng *rng, double a[3][3], double b[3][3], double depth,
                                oracle_pose *pose) {
  const int corner = shapes_pick(rng, 3);
  double m[9], e0[3], e1[3], n[3], x[3], y[3], turned[3];
  shapes_quaternion(rng, pose->rotation);
  oracle_matrix(pose->rotation, m);
  oracle_sub(b[1], b[0], e0);
  oracle_sub(b[2], b[0], e1);
  oracle_cross(e0, e1, n);
  const double length = oracle_length(n);
  if (!(length > 0)) return 0;
  memcpy(x, a[corner], sizeof x);
  oracle_sub(a[(corner + 1) % 3], x, e0);
  oracle_rotate(m, e0, turned);
  const double side = oracle_dot(n, turned) > 0 ? 1 : -1;
  proof_point_in(rng, b, y);
  oracle_rotate(m, x, turned);
  for (int k = 0; k < 3; k++) pose->position[k] = y[k] - side * depth * n[k] / length - turned[k];
  return 1;
}

// The same with points within both triangles: of a anywhere, of b as close to an edge as `depth`.
static int proof_middles_meet(shapes_rng *rng, double a[3][3], double b[3][3], double depth,
                              oracle_pose *pose) {
  const int edge = shapes_pick(rng, 3);
  const double fraction = shapes_uniform(rng, 0, 1);
  double m[9], x[3], y[3], turned[3], inwards[3];
  shapes_quaternion(rng, pose->rotation);
  oracle_matrix(pose->rotation, m);
  proof_point_in(rng, a, x);
  for (int k = 0; k < 3; k++) y[k] = b[edge][k] + fraction * (b[(edge + 1) % 3][k] - b[edge][k]);
  oracle_sub(b[(edge + 2) % 3], y, inwards);
  const double length = oracle_length(inwards);
  if (!(length > 0)) return 0;
  for (int k = 0; k < 3; k++) y[k] += fmin(depth / length, 0.5) * inwards[k];
  oracle_rotate(m, x, turned);
  for (int k = 0; k < 3; k++) pose->position[k] = y[k] - turned[k];
  return 1;
}

typedef struct crossing_sum {
  size_t tried, asked[3], free[3], witness[3], inside[3], undecided[3], records;
} crossing_sum;

// No certificate may cover the pair of patches that hold the point at t.
static void proof_none_covers(const attack *a, size_t x, size_t y, const double *point, double t,
                              crossing_sum *sum) {
  const proof_place at = proof_place_at(&a->motion, t);
  const double scale = proof_ratio(a);
  double d[3], seen[3];
  oracle_sub(point, at.position, d);
  oracle_rotate_back(at.matrix, d, seen);
  for (int k = 0; k < 3; k++) seen[k] /= scale * scale;
  for (size_t n = 0; n < heard.count; n++) {
    const proof_record *r = &heard.items[n];
    if (t < r->start || t > r->end) continue;
    if (r->kind >= HEARD_BLOCKS) {
      const proof_listing *one = &a->moving->listings[r->a];
      const proof_listing *other = &a->fixed->listings[r->b];
      sum->records += one->triangle == x && other->triangle == y && one->whole && other->whole;
      continue;
    }
    if (!proof_lists(a->moving, r->i, x) || !proof_lists(a->fixed, r->j, y)) continue;
    if (proof_holds(&a->moving->patches[r->i], seen) != 1) continue;
    sum->records += proof_holds(&a->fixed->patches[r->j], point) == 1;
  }
}

static void proof_ask_crossing(attack *a, size_t x, size_t y, double t, int moves,
                               crossing_sum *sum) {
  double point[3];
  for (size_t n = 0; n < a->motion.moving.count; n++) {
    if (oracle_length(a->motion.moving.poses[n].position) > 1e6) return;  // NSVCD_MAX_COORDINATE
  }
  const proof_body *moving = a->moving;
  proof_settle_sides(a);
  if (a->moving != moving) {
    const size_t other = x;
    x = y;
    y = other;
  }
  if (!proof_cross_at(a, x, y, t, point)) return;
  proof_ask(a);
  sum->asked[moves]++;
  sum->free[moves] += a->answer.verdict == NSVCD_FREE;
  sum->witness[moves] += status_of(&a->answer) == STATUS_WITNESS;
  sum->inside[moves] += a->answer.inside;
  sum->undecided[moves] += a->answer.verdict == NSVCD_UNDECIDED;
  proof_none_covers(a, x, y, point, t, sum);
  if (status_of(&a->answer) == STATUS_WITNESS) proof_check_witness(a);
}

// A motion that is at the pose at time t, and elsewhere before and after.
static void proof_motion_through(shapes_rng *rng, const attack *a, const oracle_pose *pose,
                                 double t, size_t count, oracle_pose *poses) {
  const double size = a->moving->size + a->fixed->size;
  const double angle = shapes_uniform(rng, 0, 1) * (count == 2 ? 3 : 6);
  const double way = shapes_pick(rng, 4) ? shapes_uniform(rng, 0, 2) * size : 100 * size;
  double axis[3], along[3], turn[4];
  shapes_direction(rng, axis);
  shapes_direction(rng, along);
  for (size_t n = 0; n < count; n++) {
    const double s = (double)n / (double)(count - 1) - t;
    oracle_axis_angle(axis, angle * s, turn);
    proof_turned(turn, pose, pose->position, &poses[n]);
    for (int k = 0; k < 3; k++) poses[n].position[k] += s * way * along[k];
  }
}

static void proof_cross_once(attack *a, shapes_rng *rng, crossing_sum *sum) {
  static const size_t counts[4] = {2, 3, 5, 17};
  const size_t x = shapes_next(rng) % a->moving->triangles;
  const size_t y = shapes_next(rng) % a->fixed->triangles;
  // else scales may be refused
  const int ordinary = a->moving->size > 1e-6 && a->moving->size < 1e4;
  const int scaled = ordinary && shapes_pick(rng, 3) == 0;
  const float scale = scaled ? (float)pow(10, shapes_uniform(rng, -1, 1)) : 1;
  const float fixed_scale = scaled ? (float)pow(10, shapes_uniform(rng, -1, 1)) : 1;
  const double size = (double)scale * a->moving->size + (double)fixed_scale * a->fixed->size;
  const double depth = size * pow(10, shapes_uniform(rng, -6.5, -1));
  const size_t count = counts[shapes_pick(rng, 4)];
  const int on_sample = count % 2 && shapes_pick(rng, 2);
  const double t = on_sample ? 0.5 : shapes_uniform(rng, 0.02, 0.98);
  double corners[3][3], other[3][3];
  oracle_pose seen, pose, fixed, poses[PROOF_POSES];
  proof_corners(a->moving, x, corners);
  proof_corners(a->fixed, y, other);
  for (int k = 0; k < 9; k++) {
    corners[k / 3][k % 3] *= (double)scale;
    other[k / 3][k % 3] *= (double)fixed_scale;
  }
  sum->tried++;
  if (shapes_pick(rng, 2) ? !proof_corner_through(rng, corners, other, depth, &seen)
                          : !proof_middles_meet(rng, corners, other, depth, &seen))
    return;
  shapes_quaternion(rng, fixed.rotation);
  for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(rng, -1, 1) * size;
  pose = oracle_compose(&fixed, &seen);
  attack placed = *a;
  proof_motion_set(&placed.motion, &pose, 1, &fixed);
  placed.motion.moving.scale = scale;
  placed.motion.fixed.scale = fixed_scale;
  proof_ask_crossing(&placed, x, y, 0, 0, sum);
  proof_motion_through(rng, a, &pose, t, count, poses);
  proof_motion_set(&a->motion, poses, count, &fixed);
  a->motion.moving.scale = scale;
  a->motion.fixed.scale = fixed_scale;
  attack carried = *a;
  proof_ask_crossing(a, x, y, t, 1, sum);
  if (shapes_pick(rng, 2)) return;
  proof_carry_unevenly(rng, &carried, shapes_uniform(rng, 0, 4 * SHAPES_PI),
                       shapes_uniform(rng, 0, 3) * size);
  proof_ask_crossing(&carried, x, y, t, 2, sum);
}

static void proof_cross_bodies(shapes_rng *rng, const proof_body *(*choose)(shapes_rng *, size_t),
                               size_t wanted) {
  static const char *const kinds[3] = {"poses", "motions", "motions of both"};
  crossing_sum sum;
  attack a;
  memset(&sum, 0, sizeof sum);
  while (sum.asked[0] + sum.asked[1] + sum.asked[2] < wanted && sum.tried < 4 * wanted) {
    const size_t scale = shapes_pick(rng, 4) ? 0 : (size_t)shapes_pick(rng, SCALES);
    a.moving = choose(rng, scale);
    a.fixed = choose(rng, scale);
    for (int k = 0; k < 20; k++) proof_cross_once(&a, rng, &sum);
  }
  for (int k = 0; k < 3; k++) {
    printf("  %s: %zu crossings: witness %zu, inside %zu, undecided %zu, free %zu\n", kinds[k],
           sum.asked[k], sum.witness[k], sum.inside[k], sum.undecided[k], sum.free[k]);
    CHECK_EQ(sum.free[k], 0);
  }
  CHECK_EQ(sum.records, 0);
  CHECK_GE(sum.asked[0] + sum.asked[1] + sum.asked[2], wanted);
}

static const proof_body *proof_any_shared(shapes_rng *rng, size_t scale) {
  return proof_shared(scale, (size_t)shapes_pick(rng, scale ? 8 : MAKES));
}
static void proof_crossings_are_never_free(void) {
  shapes_rng rng = {31};
  proof_cross_bodies(&rng, proof_any_shared, check_many(20000));
}

// Bodies whose stored points are off by more than rounding is: coarse ones, of few patches.
static const proof_body *proof_any_coarse(shapes_rng *rng, size_t scale) {
  static const int made[5] = {SOLID, BOX, BLOCK, BALL, SHEET};
  static proof_body bodies[SCALES][5];
  const size_t n = (size_t)shapes_pick(rng, 5);
  proof_body *b = &bodies[scale][n];
  if (b->body) return b;
  shapes_mesh shape;
  const nsvcd_encode_options options = {.patches = n + 1, .open = made[n] == SHEET, .coarse = 1};
  proof_shape(made[n], n, &shape);
  *b = proof_encode(&shape, proof_scales[scale], &options);
  return b;
}
static void proof_crossings_of_coarse_bodies_are_never_free(void) {
  shapes_rng rng = {32};
  proof_cross_bodies(&rng, proof_any_coarse, check_many(10000));
}

// -------------------------------------------------------------------------------------------------
// spans

// The header's motion; bodies do not matter to it.
static void proof_motion_init(const proof_motion *m, nsvcd__motion *motion) {
  nsvcd_question question =
      question_of(NULL, m->moving.raw, m->moving.count, NULL, m->fixed.raw, NULL);
  question.b.count = m->fixed.count;
  question.a.times = m->moving.timed ? m->moving.times : NULL;
  question.b.times = m->fixed.timed ? m->fixed.times : NULL;
  question.a.scale = m->moving.scale;
  question.b.scale = m->fixed.scale;
  memcpy(question.a.pivot, m->moving.pivot, sizeof question.a.pivot);
  memcpy(question.b.pivot, m->fixed.pivot, sizeof question.b.pivot);
  nsvcd__motion_init(&question.a, &question.b, motion);
  if (motion->moving.pivot) motion->moving.pivot = m->moving.pivot;  // the question's goes
  if (motion->fixed.pivot) motion->fixed.pivot = m->fixed.pivot;
}

// Where point x of the moving body is at a share of a span, less where its chord has it.
static void proof_off_chord(const proof_place *at, const nsvcd__interval *span, double fraction,
                            const double *x, double *off) {
  proof_apply(at, x, off);
  for (int i = 0; i < 3; i++) {
    double start = (double)(&span->start.position.x)[i];
    double end = (double)(&span->end.position.x)[i];
    for (int j = 0; j < 3; j++) start += (double)(&span->start.rotation.x.x)[3 * i + j] * x[j];
    for (int j = 0; j < 3; j++) end += (double)(&span->end.rotation.x.x)[3 * i + j] * x[j];
    off[i] -= start + fraction * (end - start);
  }
}

// How far points of the moving body are from their chord in one segment, less the bulge, over the
// spread; the worst found.
static double proof_span_use(const proof_motion *m, const nsvcd__interval *span, double reach,
                             shapes_rng *rng) {
  double worst = 0;
  for (int k = 0; k < 6; k++) {
    const double fraction = k == 0 ? 0 : k == 1 ? 1 : shapes_uniform(rng, 0, 1);
    const double t = heard.start + fraction * (heard.end - heard.start);
    const proof_place at = proof_place_at(m, t);
    double x[3], off[3];
    shapes_direction(rng, x);
    const double length = reach * shapes_pick(rng, 3) / 2;
    for (int i = 0; i < 3; i++) x[i] *= length;
    proof_off_chord(&at, span, fraction, x, off);
    // At the ends there is no bulge: what is off there is rounding.
    const double bulge = fraction > 0 && fraction < 1 ? (double)span->bend * length : 0;
    worst =
        fmax(worst, (oracle_length(off) - bulge) / (double)(span->rounding + span->origin_bend));
  }
  return worst;
}

// Long ways beside small bodies, in few samples or many, half turns among them.
static void proof_any_motion(shapes_rng *rng, proof_motion *m) {
  static const size_t counts[8] = {1, 2, 2, 2, 3, 5, 17, 40};
  const size_t count = counts[shapes_pick(rng, 8)];
  const double way = pow(10, shapes_uniform(rng, -2, 5.5));
  const double offset = shapes_pick(rng, 2) ? 0 : shapes_uniform(rng, 0, 1) * way;
  const double angle =
      shapes_pick(rng, 2) ? SHAPES_PI * (double)(count - 1) : shapes_uniform(rng, 0, 12);
  double along[3], axis[3], turn[4];
  oracle_pose fixed, base, poses[PROOF_POSES];
  shapes_direction(rng, along);
  shapes_direction(rng, axis);
  shapes_quaternion(rng, fixed.rotation);
  shapes_quaternion(rng, base.rotation);
  for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(rng, -1, 1) * offset;
  for (size_t n = 0; n < count; n++) {
    const double s = count > 1 ? (double)n / (double)(count - 1) - 0.5 : 0;
    oracle_axis_angle(axis, angle * s, turn);
    oracle_quat_mul(turn, base.rotation, poses[n].rotation);
    for (int k = 0; k < 3; k++) {
      poses[n].position[k] =
          fixed.position[k] + s * way * along[k] + 0.01 * way * shapes_uniform(rng, -1, 1);
    }
  }
  proof_motion_set(m, poses, count, &fixed);
  proof_set_times(*rng, &m->moving);
  proof_set_pivot(*rng, &m->moving);
}

// The same of both bodies, each on its own, and of any size.
static void proof_any_motion_of_both(shapes_rng *rng, proof_motion *m) {
  proof_motion other;
  proof_any_motion(rng, m);
  proof_any_motion(rng, &other);
  m->fixed = other.moving;
  m->moving.scale = (float)pow(10, shapes_uniform(rng, -1, 1));
  m->fixed.scale = (float)pow(10, shapes_uniform(rng, -1, 1));
}

// A segment, as the proof has it where nothing has been found.
static nsvcd__interval proof_segment(nsvcd__motion *motion, const nsvcd__search *work, size_t s) {
  static nsvcd__solver solver;
  static nsvcd__interval spans[NSVCD__MAX_SEGMENTS];
  solver.intervals = spans;
  solver.p.arcs.motion = motion;
  solver.p.known.end = HUGE_VAL;
  solver.memo.intervals = 0;
  return *nsvcd__segment_interval(&solver, work, s);
}

// A segment that is cut off somewhere, as where a first contact ends the motion.
static nsvcd__interval proof_any_clip(shapes_rng *rng, nsvcd__motion *motion, nsvcd__search *work) {
  static nsvcd__solver solver;
  static nsvcd__interval spans[NSVCD__MAX_SEGMENTS];
  size_t s = 0;
  solver.intervals = spans;
  solver.p.arcs.motion = motion;
  solver.p.arcs.arc.ticks = 0;
  solver.clipped = solver.memo.intervals = 0;
  solver.memo.plane = 0;
  solver.clipped_end = HUGE_VAL;
  for (int k = 0; k < 3; k++) {  // more than once: what is allowed doubles only once
    solver.p.known.end =
        shapes_uniform(rng, 0, 1) * fmin(solver.clipped_end, (double)motion->ticks);
    nsvcd__clip_segment(&solver, work);
  }
  while (s + 1 < work->segments && (double)work->begin[s + 1] <= solver.p.known.end) s++;
  return *nsvcd__segment_interval(&solver, work, s);
}

// A part of some arc, as the proof halves them.
static nsvcd__interval proof_any_arc(shapes_rng *rng, nsvcd__motion *motion, float lengths) {
  static nsvcd__solver solver;
  nsvcd__proof *proof = &solver.p;
  double u;
  nsvcd__arcs_begin(&proof->arcs, motion);
  proof->given.lengths = lengths;
  const uint32_t first =
      nsvcd__arc_of(motion, shapes_uniform(rng, 0, 1) * (double)motion->ticks, &u);
  const double length = pow(2, -shapes_pick(rng, 12));
  const double start = shapes_uniform(rng, 0, 1 - length);
  return nsvcd__interval_of_arc(proof, first, start, start + length);
}

// Part 3 of the theorem, by itself: between the ends of a segment every point is as near to its
// chord as the span says.
static void proof_spans_hold_the_motion(void) {
  nsvcd__search *work = &any_query()->broad_phase;
  shapes_rng rng = {404};
  double worst[5] = {0, 0, 0, 0, 0};
  size_t segments = 0;
  for (size_t trial = 0; trial < 20000; trial++) {
    const float lengths = (float)pow(10, shapes_uniform(&rng, -3, 1));
    proof_motion m;
    nsvcd__motion motion;
    if (trial % 2) proof_any_motion(&rng, &m);
    if (trial % 2 == 0) proof_any_motion_of_both(&rng, &m);
    proof_motion_init(&m, &motion);
    const float all = lengths + nsvcd__pivot_arms(&motion);
    nsvcd__cut_motion(&motion, all, work);
    const double reach = (double)lengths / (double)fmaxf(motion.scale, 1);
    for (size_t s = 0; s < work->segments; s++) {
      const nsvcd__interval span = proof_segment(&motion, work, s);
      const double use = proof_span_use(&m, &span, reach, &rng);
      // else the spread is for rounding alone
      const int has_samples = work->begin[s + 1] - work->begin[s] > 1 || motion.moving.pivot;
      const int kind = motion.fixed_moves ? 2 : has_samples;
      worst[kind] = fmax(worst[kind], use);
      segments++;
    }
    const nsvcd__interval clipped = proof_any_clip(&rng, &motion, work);
    worst[4] = fmax(worst[4], proof_span_use(&m, &clipped, reach, &rng));
    const nsvcd__interval part = proof_any_arc(&rng, &motion, all);
    worst[3] = fmax(worst[3], proof_span_use(&m, &part, reach, &rng));
  }
  printf(
      "  %zu segments: at most %.3g of what they allow beyond the bulge, %.3g where they have "
      "samples, %.3g where both move; %.3g of parts of arcs, %.3g of segments cut off\n",
      segments, worst[0], worst[1], worst[2], worst[3], worst[4]);
  CHECK_LE(worst[0], 0.9);
  CHECK_LE(worst[1], 1);
  CHECK_LE(worst[2], 1);
  CHECK_GE(worst[2], 0.5);  // else the bound says little, or the worst is not here
  CHECK_LE(worst[3], 1);
  CHECK_LE(worst[4], 1);
}

// What points are off along a direction, over what the span allows for it; the worst found.
static double proof_direction_use(const proof_motion *m, const nsvcd__interval *span, double reach,
                                  shapes_rng *rng) {
  const nsvcd__f3 own = nsvcd__own_axis(span);
  const double own_axis[3] = {(double)own.x, (double)own.y, (double)own.z};
  double worst = 0;
  for (int k = 0; k < 8; k++) {
    const double fraction = shapes_uniform(rng, 0, 1);
    const double t = heard.start + fraction * (heard.end - heard.start);
    const proof_place at = proof_place_at(m, t);
    const nsvcd__f3 special[3] = {span->axis, span->heading,
                                  nsvcd__f3_cross(span->axis, span->heading)};
    double x[3], aside[3], n[3];
    shapes_direction(rng, x);
    shapes_direction(rng, n);
    // anywhere, or near the axis, on either side of the origin
    const double slim = k % 2 ? 1 : pow(10, shapes_uniform(rng, -4, 0));
    const double side = shapes_pick(rng, 2) ? -reach : reach;
    for (int i = 0; i < 3; i++)
      x[i] = slim < 1 ? slim * reach * x[i] + sqrt(1 - slim * slim) * side * own_axis[i]
                      : reach * x[i];
    oracle_cross(x, own_axis, aside);
    const nsvcd__arm arm = {1.000001f * (float)oracle_length(x),
                            1.000001f * (float)oracle_length(aside)};
    if (k < 3) {
      const double wobble = k == 0 ? 0 : 0.01;
      n[0] = (double)special[k].x + wobble * n[0];
      n[1] = (double)special[k].y + wobble * n[1];
      n[2] = (double)special[k].z + wobble * n[2];
    }
    const double length = oracle_length(n);
    if (!(length > 0.01)) continue;
    proof_off_chord(&at, span, fraction, x, aside);
    const double off = oracle_dot(n, aside) / length;
    const nsvcd__f3 unit =
        nsvcd__f3_of((float)(n[0] / length), (float)(n[1] / length), (float)(n[2] / length));
    const double allowed = (double)span->rounding + (double)nsvcd__deviation_of(span, unit, arm);
    const nsvcd__v_interval spans = nsvcd__v_interval_set(span);
    const nsvcd__v lanes = nsvcd__v_deviation(&spans, nsvcd__v3_set(unit), arm.from_origin);
    const double in_lanes = (double)span->rounding + (double)nsvcd__v_least(lanes);
    worst = fmax(worst, fabs(off) / fmin(allowed, in_lanes));
  }
  return worst;
}

// The turn's part alone, for the point that is off the most: |D^T n| over what is allowed for it, n
// the axis or any.
static double proof_turn_use(const proof_motion *m, const nsvcd__interval *span, shapes_rng *rng) {
  double worst = 0;
  for (int k = 0; k < 8; k++) {
    const double fraction = shapes_uniform(rng, 0, 1);
    const double t = heard.start + fraction * (heard.end - heard.start);
    const proof_place at = proof_place_at(m, t);
    const double axis[3] = {(double)span->axis.x, (double)span->axis.y, (double)span->axis.z};
    const double zero[3] = {0, 0, 0};
    double n[3], origin[3], across[3], off[3];
    shapes_direction(rng, n);
    if (k % 2) memcpy(n, axis, sizeof n);
    proof_apply(&at, zero, origin);
    for (int j = 0; j < 3; j++) {
      const double unit[3] = {j == 0, j == 1, j == 2};
      double column[3];
      proof_apply(&at, unit, column);
      off[j] = 0;
      for (int i = 0; i < 3; i++) {
        const double start = (double)(&span->start.rotation.x.x)[3 * i + j];
        const double end = (double)(&span->end.rotation.x.x)[3 * i + j];
        off[j] += n[i] * (column[i] - origin[i] - start - fraction * (end - start));
      }
    }
    oracle_cross(n, axis, across);
    const double allowed = fabs(oracle_dot(n, axis)) * (double)span->bend_along_axis +
                           oracle_length(across) * (double)span->bend;
    worst = fmax(worst, oracle_length(off) / (allowed + 1e-6));
  }
  return worst;
}

// Four arcs to a segment, about axes on all sides of the segment's own: along that, samples and
// arcs stray alike.
static void proof_zigzag_motion(shapes_rng *rng, proof_motion *m) {
  const size_t count = 65;
  const double turn = shapes_uniform(rng, 0.02, 0.08);
  const double tilt = shapes_uniform(rng, 0, 1.2);
  double axis[3], side[4][3], step[4];
  oracle_pose fixed, poses[PROOF_POSES];
  shapes_direction(rng, axis);
  for (int k = 0; k < 4; k++) shapes_direction(rng, side[k]);
  shapes_quaternion(rng, fixed.rotation);
  shapes_quaternion(rng, poses[0].rotation);
  for (int k = 0; k < 3; k++) fixed.position[k] = 0;
  for (size_t n = 0; n < count; n++) {
    double now[3];
    for (int k = 0; k < 3; k++) {
      poses[n].position[k] = 0;
      now[k] = axis[k] + tilt * side[(n + 3) % 4][k];
    }
    if (n == 0) continue;
    const double length = oracle_length(now);
    for (int k = 0; k < 3; k++) now[k] /= length > 0 ? length : 1;
    oracle_axis_angle(now, turn, step);
    oracle_quat_mul(step, poses[n - 1].rotation, poses[n].rotation);
    oracle_quat_normalize(poses[n].rotation);
  }
  proof_motion_set(m, poses, count, &fixed);
}

// A motion of many samples, some to a segment, whose axis wanders as much as its way.
static void proof_wandering_motion(shapes_rng *rng, proof_motion *m) {
  const size_t count = 33 + (size_t)shapes_pick(rng, PROOF_POSES - 32);
  const double turn = shapes_uniform(rng, 0, 3);
  const double wander = shapes_pick(rng, 3) ? shapes_uniform(rng, 0, 2) : 0;
  double axis[3], drift[3], way[3], bend[3], step[4];
  oracle_pose fixed, poses[PROOF_POSES];
  shapes_direction(rng, axis);
  shapes_direction(rng, drift);
  shapes_direction(rng, way);
  shapes_direction(rng, bend);
  shapes_quaternion(rng, fixed.rotation);
  shapes_quaternion(rng, poses[0].rotation);
  for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(rng, -0.1, 0.1);
  for (size_t n = 0; n < count; n++) {
    const double s = (double)n / (double)(count - 1);
    double now[3];
    for (int k = 0; k < 3; k++) {
      poses[n].position[k] = 0.3 * (s * s * way[k] + wander * sin(9 * s) * 0.1 * bend[k]);
      now[k] = axis[k] + wander * sin(25 * s) * drift[k];
    }
    if (n == 0) continue;
    const double length = oracle_length(now);
    for (int k = 0; k < 3; k++) now[k] /= length > 0 ? length : 1;
    oracle_axis_angle(now, turn / (double)(count - 1), step);
    oracle_quat_mul(step, poses[n - 1].rotation, poses[n].rotation);
    oracle_quat_normalize(poses[n].rotation);
  }
  proof_motion_set(m, poses, count, &fixed);
}

// What is said of directions: along the axis of a turn, and across the way, points hardly leave
// their chords.
static void proof_spans_hold_along_directions(void) {
  nsvcd__search *work = &any_query()->broad_phase;
  shapes_rng rng = {405};
  double worst = 0;
  double turned = 0;
  size_t segments = 0;
  for (size_t trial = 0; trial < 4000; trial++) {
    const float reach = (float)pow(10, shapes_uniform(&rng, -2, 0));
    proof_motion m;
    nsvcd__motion motion;
    if (trial % 4 == 0) {
      proof_any_motion(&rng, &m);
    } else if (trial % 4 == 1) {
      proof_zigzag_motion(&rng, &m);
    } else {
      proof_wandering_motion(&rng, &m);
    }
    if (trial % 3 == 0) {
      proof_motion other;
      proof_wandering_motion(&rng, &other);
      m.fixed = other.moving;
    }
    proof_motion_init(&m, &motion);
    nsvcd__cut_motion(&motion, 2 * reach + nsvcd__pivot_arms(&motion), work);
    for (size_t k = 0; k < work->segments; k++, segments++) {
      const nsvcd__interval span = proof_segment(&motion, work, k);
      worst = fmax(worst, proof_direction_use(&m, &span, (double)reach, &rng));
      turned = fmax(turned, proof_turn_use(&m, &span, &rng));
    }
  }
  printf(
      "  %zu segments: at most %.3g of what they allow along a direction, %.3g of that for turns\n",
      segments, worst, turned);
  CHECK_LE(worst, 1);
  CHECK_LE(turned, 1);
  CHECK_GE(worst, 0.5);  // else the bound says little, or the worst is not here
}

// Wheels: both bodies turn about nearly one axis, the one perhaps about the other.
static void proof_wheels_motion(shapes_rng *rng, proof_motion *m) {
  const double tilt = shapes_pick(rng, 2) ? 0 : pow(10, shapes_uniform(rng, -4, 0));
  double axis[3];
  shapes_direction(rng, axis);
  for (int n = 0; n < 2; n++) {
    const double turn = shapes_uniform(rng, -2.5, 2.5);
    oracle_pose poses[3];
    double aside[3], step[4];
    shapes_direction(rng, aside);
    for (int k = 0; k < 3; k++) axis[k] += tilt * aside[k];
    const double length = oracle_length(axis);
    for (int k = 0; k < 3; k++) axis[k] /= length;
    oracle_axis_angle(axis, turn, step);
    shapes_quaternion(rng, poses[0].rotation);
    for (int i = 0; i < 3; i++) {
      if (i > 0) oracle_quat_mul(step, poses[i - 1].rotation, poses[i].rotation);
      for (int k = 0; k < 3; k++) poses[i].position[k] = n * 0.3 * aside[k];
    }
    proof_track_set(n ? &m->moving : &m->fixed, poses, 3);
  }
}

// What is said of arcs in double: a point's true way between two times, over what its pair allows
// for along a direction; 0 where nothing bends.
static double proof_arc_use(const proof_motion *m, nsvcd__motion *motion, shapes_rng *rng) {
  static nsvcd__proof proof;
  nsvcd__triangle_pair pair;
  double fraction, ends[3][3], n[3], x[3];
  proof.arcs.motion = motion;
  proof.arcs.arc.ticks = 0;
  const uint32_t first =
      nsvcd__arc_of(motion, shapes_uniform(rng, 0, 1) * (double)motion->ticks, &fraction);
  const nsvcd__arc *arc = nsvcd__arc_at(&proof.arcs, first);
  const double length = pow(2, -shapes_pick(rng, 8));
  const double u0 = shapes_uniform(rng, 0, 1 - length);
  const double within = shapes_pick(rng, 2) ? 0.5 : shapes_uniform(rng, 0, 1);
  const double u[3] = {u0, u0 + within * length, u0 + length};
  const double slim = shapes_pick(rng, 2) ? 1 : pow(10, shapes_uniform(rng, -4, 0));
  shapes_direction(rng, x);
  shapes_direction(rng, n);
  for (int k = 0; k < 3; k++) x[k] = slim * x[k] + (1 - slim) * (&arc->own_axis.x)[k];
  for (int k = 0; k < 3; k++) pair.moving[k] = nsvcd__d3_of(x[0], x[1], x[2]);
  const int looks = shapes_pick(rng, 4);
  if (looks == 0) memcpy(n, &arc->axis.x, sizeof n);
  if (looks == 1) {  // where it is off the most, if both turn about one axis
    double out[3], place[3];
    proof_place at = proof_place_at(m, proof_time_in_arc(&proof, u[1]));
    memset(at.position, 0, sizeof at.position);
    proof_apply(&at, x, place);
    const double axis[3] = {arc->axis.x, arc->axis.y, arc->axis.z};
    for (int k = 0; k < 3; k++) out[k] = place[k] - oracle_dot(place, axis) * axis[k];
    memcpy(n, out, sizeof n);
  }
  const double size = oracle_length(n);
  if (!(size > 1e-9)) return 0;
  for (int k = 0; k < 3; k++) {
    const proof_place at = proof_place_at(m, proof_time_in_arc(&proof, u[k]));
    proof_apply(&at, x, ends[k]);
  }
  double off = 0;
  for (int k = 0; k < 3; k++)
    off += n[k] / size * (ends[1][k] - (1 - within) * ends[0][k] - within * ends[2][k]);
  nsvcd__pair_arm(arc, &pair);
  const nsvcd__d3 unit = nsvcd__d3_of(n[0] / size, n[1] / size, n[2] / size);
  const double allowed = length * length * nsvcd__off_chord_along(arc, &pair, unit);
  const double lengths = 1 + oracle_length(ends[0]) + oracle_length(ends[2]);
  const nsvcd__interval span = nsvcd__interval_of_arc(&proof, first, u0, u0 + length);
  const nsvcd__arm arm = nsvcd__arm_of(nsvcd__d3_narrow(pair.moving[0]), 0, nsvcd__own_axis(&span));
  const double by_span = (double)nsvcd__deviation_of(&span, nsvcd__d3_narrow(unit), arm);
  const double use = fabs(off) / (by_span + 2e-6 * lengths);
  return fmax(use, fabs(off) / (allowed + 1e-12 * lengths));
}

static void proof_arcs_hold_along_directions(void) {
  shapes_rng rng = {406};
  double worst[3] = {0, 0, 0};
  for (size_t trial = 0; trial < check_many(60000); trial++) {
    const size_t kind = trial % 3;
    proof_motion m;
    nsvcd__motion motion;
    if (kind == 0) proof_wandering_motion(&rng, &m);
    if (kind == 1) proof_any_motion_of_both(&rng, &m);
    if (kind == 2) proof_wheels_motion(&rng, &m);
    proof_motion_init(&m, &motion);
    nsvcd__cut_motion(&motion, 2, &any_query()->broad_phase);
    worst[kind] = fmax(worst[kind], proof_arc_use(&m, &motion, &rng));
  }
  printf("  at most %.3g of what is allowed, %.3g where both move, %.3g of wheels\n", worst[0],
         worst[1], worst[2]);
  for (int k = 0; k < 3; k++) CHECK_LE(worst[k], 1);
  for (int k = 0; k < 3; k++) CHECK_GE(worst[k], 0.5);
}

// -------------------------------------------------------------------------------------------------
// first contact, clearance, and the least of it: against conservative advancement in double

static double proof_distance_at(const attack *a, double t) {
  const oracle_pose pose = proof_pose_at(&a->motion.moving, t);
  const oracle_pose fixed = proof_pose_at(&a->motion.fixed, t);
  return oracle_distance(&a->moving->oracle, &pose, &a->fixed->oracle, &fixed, NULL, NULL);
}

// How fast points of a body may be from t until its next pose, at *next.
static double proof_track_rate(const proof_track *m, double size, double t, double *next) {
  *next = 1;
  if (m->count < 2) return 0;
  const size_t k = proof_pose_before(m, t);
  *next = proof_time_of(m, k + 1);
  return proof_track_way(m, k, size) / (*next - proof_time_of(m, k));
}

// The first time from which it cannot be said that surfaces are farther apart than `clearance`:
// they come within that and `hair` more. 2 if they never do.
static double proof_first_approach(const attack *a, double clearance, double epsilon) {
  for (double t = 0; t <= 1;) {
    double next, fixed_next;
    const double room = proof_distance_at(a, t) - clearance;
    if (room <= epsilon) return t;
    if (t >= 1) break;
    const double rate = proof_track_rate(&a->motion.moving, a->moving->size, t, &next) +
                        proof_track_rate(&a->motion.fixed, a->fixed->size, t, &fixed_next);
    const double until = fmin(fmin(next, fixed_next), 1);
    const double step = rate > 0 ? room / rate : 1;
    t = t + step < until ? t + step : until + (until < 1 ? 1e-15 : 0);
  }
  return 2;
}

// Is there a time before `until` at which surfaces are within the clearance by more than `hair`?
// From the first approach on at many times, not all. `from`: that time, proof_first_approach.
static int proof_is_within(const attack *a, double clearance, double from, double until,
                           double epsilon) {
  for (int k = 0; k <= 100 && from < until; k++) {
    const double t = from + (until - from) * k / 100;
    const double distance = proof_distance_at(a, t);
    if (clearance > 0 ? distance < clearance - epsilon : !(distance > 0)) return 1;
  }
  return 0;
}

static int proof_comes_within(const attack *a, double clearance, double epsilon) {
  return proof_is_within(a, clearance, proof_first_approach(a, clearance, epsilon), 1, epsilon);
}

typedef struct timing_sum {
  size_t asked, contacts, free, inside, undecided, at_start, blurred, spent, wrong;
  double worst;  // of the tolerance
} timing_sum;

static void proof_count(timing_sum *sum, status said) {
  sum->asked++;
  sum->contacts += said == STATUS_WITNESS;
  sum->free += said == STATUS_CERTIFIED_FREE;
  sum->inside += said == STATUS_INSIDE;
  sum->undecided += said == STATUS_UNDECIDED;
}

// Both bodies' quanta together, without their scales.
static double proof_quanta(const attack *a) {
  return (double)nsvcd_body_describe(a->moving->body).quantization_error +
         (double)nsvcd_body_describe(a->fixed->body).quantization_error;
}

// A witness is as late as was allowed, or what comes before it begins with a doubt: surfaces that
// are nearer than what can be told.
static void proof_check_lateness(const attack *a, double first, double tolerance, timing_sum *sum) {
  const double until = (double)a->answer.time.low;
  const double late = (double)a->answer.nearest.time - until;
  const double size = a->moving->size + a->fixed->size;
  if (late <= first * 1.00001 + 3e-7) {
    sum->worst = fmax(sum->worst, late / first);
    return;
  }
  sum->blurred++;
  const double apart = proof_distance_at(a, until);
  CHECK_LE(apart, tolerance + 4 * proof_quanta(a) + 1e-6 * size);
}

// Does the answer to a question that asks for more agree with that to one which asks for yes or no?
// What is inside is a hit; asked for more it may be known to meet as well.
static int proof_agree(status plain, status more) {
  const int is_inside = plain == STATUS_INSIDE && more == STATUS_WITNESS;
  return plain == more || plain == STATUS_UNDECIDED || is_inside;
}

static void proof_check_first(attack *a, float tolerance, double from, timing_sum *sum) {
  const double size = a->moving->size + a->fixed->size;
  nsvcd_question options = proof_options();
  proof_ask(a);
  const nsvcd_answer plain = a->answer;
  proof_ask_first(&options, tolerance);
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const nsvcd_answer *first = &a->answer;
  proof_count(sum, status_of(first));
  if (plain.verdict != NSVCD_UNDECIDED && first->verdict != NSVCD_UNDECIDED) {
    CHECK(proof_agree(status_of(&plain), status_of(first)));
  }
  CHECK(first->time.low >= 0 && first->time.low <= 1);
  if (first->inside) return;
  sum->wrong += proof_is_within(a, 0, from, (double)first->time.low, 1e-6 * size);
  if (first->verdict == NSVCD_FREE) CHECK_EQ(first->time.low, 1);
  if (status_of(first) != STATUS_WITNESS) return;
  proof_check_witness(a);
  const int at_start = !(proof_distance_at(a, 0) > 0);
  sum->at_start += at_start;
  if (at_start) CHECK_EQ(first->nearest.time, 0);
  proof_check_lateness(a, (double)tolerance, 0, sum);
  proof_check_manifold(a, &options);
}

// What comes within the tolerance may be left undecided, but is not called a contact.
static void proof_check_first_with_doubts(attack *a, double tolerance, double from,
                                          timing_sum *sum) {
  const double size = a->moving->size + a->fixed->size;
  nsvcd_question options = proof_options();
  proof_ask_first(&options, 0.001f);
  options.tolerance = (float)(tolerance * size);
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const nsvcd_answer *first = &a->answer;
  proof_count(sum, status_of(first));
  if (first->inside) return;
  sum->wrong += proof_is_within(a, 0, from, (double)first->time.low, 1e-6 * size);
  if (status_of(first) == STATUS_WITNESS) {
    proof_check_lateness(a, 0.001, (double)options.tolerance, sum);
    proof_check_witness(a);
  }
  if (first->verdict == NSVCD_UNDECIDED) {
    CHECK_LE(first->distance.high, options.tolerance + 4 * proof_quanta(a) + 1e-6 * size);
    proof_check_triangles(a, 0);
  }
}

// With hardly any work allowed: what is said to be free until then is.
static void proof_check_first_in_haste(attack *a, size_t limit, double from, timing_sum *sum) {
  nsvcd_question options = proof_options();
  proof_ask_first(&options, 0.01f);
  options.work = limit;
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const nsvcd_answer *first = &a->answer;
  if (status_of(first) == STATUS_WITNESS)
    proof_check_witness(a);
  else if (first->verdict != NSVCD_UNDECIDED)
    return;
  if (!(first->time.low > 0)) return;
  sum->asked++;
  sum->wrong += proof_is_within(a, 0, from, (double)first->time.low,
                                1e-6 * (a->moving->size + a->fixed->size));
}

// A scene in which bodies hit, or nearly, alone or carried along.
static int proof_timing_scene(shapes_rng *rng, attack *a) {
  proof_any_two(rng, a);
  const double gap = shapes_pick(rng, 2) ? -0.05 : pow(10, shapes_uniform(rng, -6, -1));
  if (!proof_scene(rng, a, gap, 0.3)) return 0;
  const double size = a->moving->size + a->fixed->size;
  if (shapes_pick(rng, 2))
    proof_carry_unevenly(rng, a, shapes_uniform(rng, 0, 6), shapes_uniform(rng, 0, 2) * size);
  return 1;
}

static void proof_finds_first_contacts(void) {
  static const float tolerances[3] = {0.1f, 0.01f, 1e-3f};
  const size_t wanted = check_many(20);
  shapes_rng rng = {88};
  timing_sum sum, fine, doubtful, hasty;
  memset(&sum, 0, sizeof sum);
  memset(&fine, 0, sizeof fine);
  memset(&doubtful, 0, sizeof doubtful);
  memset(&hasty, 0, sizeof hasty);
  while (sum.asked < wanted) {
    attack a;
    if (!proof_timing_scene(&rng, &a)) continue;
    const double from = proof_first_approach(&a, 0, 1e-6 * (a.moving->size + a.fixed->size));
    proof_check_first(&a, tolerances[shapes_pick(&rng, 3)], from, &sum);
    proof_check_first(&a, 1e-4f, from, &fine);
    proof_check_first_with_doubts(&a, pow(10, shapes_uniform(&rng, -4, -1)), from, &doubtful);
    for (size_t limit = 2; limit < 300; limit *= 2)
      proof_check_first_in_haste(&a, limit, from, &hasty);
  }
  printf("  with little work: %zu beginnings, %zu of those wrong\n", hasty.asked, hasty.wrong);
  CHECK_EQ(hasty.wrong, 0);
  printf(
      "  with a tolerance: %zu first contacts, %zu of them after a doubt; %zu undecided; %zu "
      "wrong\n",
      doubtful.contacts, doubtful.blurred, doubtful.undecided, doubtful.wrong);
  CHECK_EQ(doubtful.wrong, 0);
  CHECK_GE(doubtful.contacts, wanted / 10);
  CHECK_GE(doubtful.undecided + doubtful.blurred, wanted / 50);
  // so short a time is less than what it may take to pass through the quanta
  printf(
      "  to 1e-4: %zu first contacts, %zu of them after a doubt; %zu undecided; %zu wrong; late "
      "by %.3f of that\n",
      fine.contacts, fine.blurred, fine.undecided, fine.wrong, fine.worst);
  CHECK_EQ(fine.wrong, 0);
  CHECK_GE(fine.contacts, fine.asked / 3);
  CHECK_GE(hasty.asked, 20);
  printf(
      "  %zu questions: first contacts %zu, %zu of them at the start, %zu after a doubt; free %zu, "
      "inside %zu, "
      "undecided %zu; %zu wrong; "
      "late by %.3f of the tolerance\n",
      sum.asked, sum.contacts, sum.at_start, sum.blurred, sum.free, sum.inside, sum.undecided,
      sum.wrong, sum.worst);
  CHECK_EQ(sum.wrong, 0);
  CHECK_GE(sum.contacts, sum.asked / 4);
  CHECK_GE(sum.at_start, wanted / 20);
  CHECK_LE(sum.undecided, 2 + sum.asked / 20);
}

static void proof_check_clearance(attack *a, float clearance, timing_sum *sum) {
  const double size = a->moving->size + a->fixed->size;
  nsvcd_question options = proof_options();
  options.clearance = clearance;
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const nsvcd_answer *w = &a->answer;
  proof_count(sum, status_of(w));
  if (w->verdict == NSVCD_FREE) {
    sum->wrong += proof_comes_within(a, (double)clearance, 1e-6 * size);
    CHECK_LE(fabs((double)w->distance.low / (double)clearance - 1), 1e-5);
    CHECK_EQ(w->time.low, 1);
  }
  if (status_of(w) != STATUS_WITNESS) return;
  const double moved = proof_speed_bound(a, (double)w->nearest.time, 6e-8);
  const double distance = proof_distance_at(a, (double)w->nearest.time);
  CHECK_LE(distance, (double)w->distance.high + moved + 1e-9 * size);
  const double quanta = proof_quanta(a);
  CHECK_LE((double)w->distance.high, (double)clearance * (1 + 1e-5) + quanta);
}

// However widely the least distance is asked for, a clearance is kept or not.
static void proof_check_both(attack *a, float clearance, float tolerance, timing_sum *sum) {
  nsvcd_question options = proof_options();
  options.clearance = clearance;
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const status alone = status_of(&a->answer);
  proof_ask_distance(&options, tolerance);
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const nsvcd_answer *w = &a->answer;
  proof_count(sum, status_of(w));
  sum->wrong += !proof_agree(alone, status_of(w)) && w->verdict != NSVCD_UNDECIDED;
  CHECK(w->verdict != NSVCD_UNDECIDED || alone == STATUS_UNDECIDED);
  if (w->verdict == NSVCD_FREE) CHECK_GE((double)w->distance.low, (double)clearance * (1 - 1e-5));
}

static void proof_check_measure(attack *a, float tolerance, timing_sum *sum) {
  const double size = a->moving->size + a->fixed->size;
  nsvcd_question options = proof_options();
  proof_ask_distance(&options, tolerance);
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  const nsvcd_answer *w = &a->answer;
  proof_count(sum, status_of(w));
  CHECK(w->distance.low >= 0 && w->distance.low <= w->distance.high);
  CHECK_EQ(w->time.low, w->verdict == NSVCD_FREE);
  if (w->inside) return;
  if (w->distance.low > 0)
    sum->wrong += proof_comes_within(a, (double)w->distance.low, 1e-6 * size);
  // they do come as near as that, also where no triangles are named
  sum->wrong += proof_first_approach(a, (double)w->distance.high + 2e-6 * size, 1e-6 * size) > 1;
  const double moved = proof_speed_bound(a, (double)w->nearest.time, 6e-8);
  if (w->nearest.triangle_a != NSVCD_NO_TRIANGLE) {
    CHECK_LE(proof_distance_at(a, (double)w->nearest.time),
             (double)w->distance.high + moved + 1e-9 * size);
  }
  const double quanta = proof_quanta(a);
  const double wide = (double)w->distance.high - (double)w->distance.low;
  CHECK_GE(w->distance.high, 0);
  // both ends are rounded outward, by a millionth of themselves
  const double rounded = 2e-6 * (double)w->distance.high + 1e-5 * size;
  if (w->work >= NSVCD_DEFAULT_WORK)
    sum->spent++;
  else
    sum->worst =
        fmax(sum->worst, (wide - quanta) / (fmax((double)tolerance, 2 * quanta) + rounded));
}

static void proof_keeps_clearances(void) {
  shapes_rng rng = {89};
  timing_sum sums[3];
  static const char *const names[3] = {"clearance", "least", "both"};
  memset(sums, 0, sizeof sums);
  while (sums[0].asked < check_many(100)) {
    attack a;
    if (!proof_timing_scene(&rng, &a)) continue;
    const double size = a.moving->size + a.fixed->size;
    const float clearance = (float)(size * pow(10, shapes_uniform(&rng, -5, 0.3)));
    proof_check_clearance(&a, clearance, &sums[0]);
    proof_check_both(&a, clearance, (float)size, &sums[2]);
    proof_check_measure(&a, (float)(size * pow(10, shapes_uniform(&rng, -5, -1))), &sums[1]);
  }
  for (int k = 0; k < 3; k++) {
    const timing_sum *sum = &sums[k];
    printf("  %s: %zu questions, near %zu, free %zu, inside %zu, undecided %zu; %zu wrong",
           names[k], sum->asked, sum->contacts, sum->free, sum->inside, sum->undecided, sum->wrong);
    printf(k == 1 ? "; brackets up to %.3f of the tolerance, %zu ran out of work\n" : "\n",
           sum->worst, sum->spent);
    CHECK_EQ(sum->wrong, 0);
    CHECK_GE(sum->free, sum->asked / 8);
    CHECK_GE(sum->contacts, sum->asked / 8);
    CHECK_LE(sum->undecided, 2 + sum->asked / 10);
  }
  CHECK_LE(sums[1].worst, 1);
  CHECK_LE(sums[1].spent, 2 + sums[1].asked / 50);
}

// -------------------------------------------------------------------------------------------------
// what is only remembered

// What a proof remembers may be forgotten at any time, and no verdict changes; with skins, first
// contacts, clearances and distances too.
static void proof_may_forget(void) {
  shapes_rng rng = {0xf0};
  size_t asked = 0;
  size_t more_work = 0;
  heard.forgotten = 0;
  while (asked < check_many(100)) {
    attack a;
    if (!proof_timing_scene(&rng, &a)) continue;
    const double size = a.moving->size + a.fixed->size;
    nsvcd_question options = proof_options();
    options.work = 0xffffffffu;
    if (asked % 5 == 1) options.clearance = (float)(size * shapes_uniform(&rng, 0, 0.2));
    if (asked % 5 == 2) proof_ask_first(&options, 0.01f);
    if (asked % 5 == 3) options.slop = (float)(size * shapes_uniform(&rng, 0, 0.1));
    if (asked % 5 == 4) proof_ask_distance(&options, (float)(0.01 * size));
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    const nsvcd_answer whole = a.answer;
    heard.forgetful = 1 + (unsigned)asked % 3;
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    heard.forgetful = 0;
    CHECK_EQ(status_of(&a.answer), status_of(&whole));
    if (options.ask == NSVCD_ASK_FIRST) {
      CHECK_LE(fabs((double)(a.answer.nearest.time - whole.nearest.time)), 0.0101);
      CHECK_LE(fabs((double)(a.answer.time.low - whole.time.low)), 0.0101);
    }
    if (options.ask == NSVCD_ASK_DISTANCE) {
      CHECK_LE(a.answer.distance.low, whole.distance.high);
      CHECK_LE(whole.distance.low, a.answer.distance.high);
    }
    more_work += a.answer.work > whole.work;
    asked++;
  }
  printf("  %zu questions, forgotten %u times, %zu took more work for it\n", asked, heard.forgotten,
         more_work);
  CHECK_GE(heard.forgotten, asked);
  CHECK_GE(more_work, asked / 10);
}

// -------------------------------------------------------------------------------------------------
// leaving a contact

// A floor, and with `wall` a wall on its far side (x > 0.5), of many triangles or few.
static proof_body proof_floor_with(const nsvcd_encode_options *options, int wall, int cuts) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 2, 2, 0.1, cuts);
  // its top is z = 0
  for (size_t i = 0; i < shape.vertices; i++) shape.positions[3 * i + 2] -= 0.05;
  if (wall) shapes_box_at(&shape, 0.55, 0, 0.5, 0.1, 2, 1);
  return proof_encode(&shape, 1, options);
}
static proof_body proof_floor(int wall, int cuts) {
  return proof_floor_with(NULL, wall, cuts);
}
static proof_body proof_crate(int cuts) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 0.2, 0.2, 0.2, cuts);
  return proof_encode(&shape, 1, NULL);
}

// Asks about a crate whose lowest points go from z0 to z1 and which goes from x0 to x1; everything
// turned and moved along.
static nsvcd_answer proof_push(attack *a, shapes_rng *rng, double x0, double x1, double z0,
                               double z1, float skin, float clearance, float first) {
  nsvcd_question options = proof_options();
  oracle_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
  oracle_pose poses[3];
  if (shapes_pick(rng, 2)) shapes_quaternion(rng, fixed.rotation);
  if (shapes_pick(rng, 2)) {
    for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(rng, -1, 1);
  }
  for (int n = 0; n < 3; n++) {
    const double t = 0.5 * n;
    oracle_pose seen = {{x0 + t * (x1 - x0), 0.1, 0.1 + z0 + t * (z1 - z0)}, {0, 0, 0, 1}};
    poses[n] = oracle_compose(&fixed, &seen);
  }
  proof_motion_set(&a->motion, poses, 3, &fixed);
  if (shapes_pick(rng, 2)) proof_carry(rng, a, 0, 1);  // a turn would press it in between poses
  options.slop = skin;
  options.clearance = clearance;
  if (first > 0) proof_ask_first(&options, first);
  CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
  return a->answer;
}

// A crate that rests on a floor, is pushed along it, lifted off it, pressed into it, pushed against
// a wall.
static void proof_leaves_contacts(void) {
  const float skin = 1e-3f;
  shapes_rng rng = {90};
  for (int make = 0; make < 8; make++) {
    const int wall = make % 2;
    proof_body floor = proof_floor(wall, make & 2 ? 2 : 12);
    proof_body crate = proof_crate(make & 4 ? 1 : 6);
    attack a;
    for (int trial = 0; trial < 4 * 12; trial++) {
      const int k = trial % 12;
      static const double heights[12][2] = {
          {0, 0},       {0, 0},       {0, 0.1}, {-5e-4, -5e-4}, {-3e-3, -3e-3}, {0, -5e-3},
          {2e-5, 2e-5}, {8e-4, 8e-4}, {0, 0},   {0, 0},         {-3e-3, 0.1},   {0, -5e-4}};
      // there the skin is all of it: as near as touching
      const float clearance = k == 7 || k == 9 ? 1e-3f : 0;
      const double far_end = k == 8 && wall ? 0.45 : 0.2;
      a.moving = &crate;
      a.fixed = &floor;
      const nsvcd_answer answer =
          proof_push(&a, &rng, k == 1 ? -0.3 : 0, k == 1 ? -0.3 : far_end, heights[k][0],
                     heights[k][1], k == 9 ? 2 * skin : skin, clearance, 0.01f);
      const double lift = sqrt((double)(answer.push_out[0] * answer.push_out[0] +
                                        answer.push_out[1] * answer.push_out[1] +
                                        answer.push_out[2] * answer.push_out[2]));
      const int pressed = k == 4 || k == 10;
      const int hits = pressed || k == 5 || (k == 8 && wall);
      CHECK_EQ(answer.verdict == NSVCD_HIT, hits);
      CHECK_EQ(answer.verdict == NSVCD_FREE, !hits);
      if (pressed) CHECK_EQ(lift, 0);
      if (pressed) CHECK_EQ(answer.nearest.time, 0);
      if (!pressed) CHECK_NEAR(lift, k == 9 ? 2 * skin : skin, 1e-5);
      if (k == 5) CHECK_NEAR(answer.nearest.time, 0.2, 0.012);  // a skin deep of five
      if (k == 8 && wall) CHECK_NEAR(answer.nearest.time, 0.4 / 0.45, 0.012);
    }
    proof_free(&floor);
    proof_free(&crate);
  }
}

// A crate pushed along a floor against a wall, or the floor lifted off the crate: a lift the other
// way, and the point where the body that is lifted then is.
static void proof_points_are_of_the_lifted(void) {
  proof_body floor = proof_floor(1, 2);
  proof_body crate = proof_crate(1);
  nsvcd_pose path[2] = {{{0, 0, 0.1f}, {0, 0, 0, 1}}, {{0.45f, 0, 0.1f}, {0, 0, 0, 1}}};
  nsvcd_question question;
  nsvcd_answer answers[2];
  memset(&question, 0, sizeof question);
  question.method = NSVCD_METHOD_PROOF;
  question.slop = 0.01f;
  question.ask = NSVCD_ASK_FIRST;
  question.to_time = 1e-3f;
  for (int swapped = 0; swapped < 2; swapped++) {
    nsvcd_mover *mover = swapped ? &question.b : &question.a;
    nsvcd_mover *rest = swapped ? &question.a : &question.b;
    memset(rest, 0, sizeof *rest);
    mover->body = crate.body;
    mover->poses = path;
    mover->count = 2;
    rest->body = floor.body;
    CHECK_EQ(nsvcd_sweep(&question, proof_workspace(), nsvcd_sweep_workspace_size(NULL),
                         &answers[swapped]),
             NSVCD_OK);
    CHECK_EQ(status_of(&answers[swapped]), STATUS_WITNESS);
  }
  CHECK_NEAR(answers[0].push_out[2], 0.01, 1e-5);
  CHECK_NEAR(answers[0].nearest.point[0], 0.5, 5e-5);  // the wall, to its quantum
  for (int k = 0; k < 3; k++) {
    CHECK_EQ(answers[1].push_out[k], -answers[0].push_out[k]);
    CHECK_NEAR(answers[1].nearest.point[k], answers[0].nearest.point[k] + answers[1].push_out[k],
               1e-6);
  }
  proof_free(&floor);
  proof_free(&crate);
}

// The distance at t when the moving body is displaced by the lift, which turns with the fixed one.
static double proof_lifted_distance(const attack *a, const double *lift, double t) {
  const oracle_pose start = proof_pose_at(&a->motion.fixed, 0);
  const oracle_pose fixed = proof_pose_at(&a->motion.fixed, t);
  oracle_pose pose = proof_pose_at(&a->motion.moving, t);
  double at_start[9], now[9], seen[3], turned[3];
  oracle_matrix(start.rotation, at_start);
  oracle_matrix(fixed.rotation, now);
  oracle_rotate_back(at_start, lift, seen);
  oracle_rotate(now, seen, turned);
  for (int k = 0; k < 3; k++) pose.position[k] += turned[k];
  return oracle_distance(&a->moving->oracle, &pose, &a->fixed->oracle, &fixed, NULL, NULL);
}

// Where the answer sends the bodies, are they apart?
static int proof_is_safe(const attack *a) {
  const oracle_pose moving = pose_widened(&a->answer.safe.a);
  const oracle_pose fixed = pose_widened(&a->answer.safe.b);
  return oracle_distance(&a->moving->oracle, &moving, &a->fixed->oracle, &fixed, NULL, NULL) > 0;
}

// Of a lift along one normal: do the bodies stay apart once they are lifted by the depth, to a
// hundredth and what is told in float; and by less, are they not?
static void proof_check_depth(const attack *a, const double *lift, size_t *too_short,
                              size_t *too_long) {
  const double length = oracle_length(lift);
  const double depth = (double)a->answer.depth;
  const double epsilon = 1.2e-7 * (a->moving->size + a->fixed->size) + 0.005 * depth;
  double way[3];
  int apart = 1;
  for (int n = 0; n <= 20 && apart; n++) {
    const double beyond = fmin(depth + epsilon + 0.05 * n * (length - depth - epsilon), length);
    for (int k = 0; k < 3; k++) way[k] = lift[k] / length * beyond;
    apart = proof_lifted_distance(a, way, 0) > 0;
  }
  *too_short += !apart;
  for (int k = 0; k < 3; k++) way[k] = lift[k] / length * (depth - epsilon);
  *too_long += depth > epsilon && proof_lifted_distance(a, way, 0) > epsilon;
}

// Any bodies that touch at the start: what is said to be free is free when lifted, and the lift is
// short; where they are sent they are apart, and their depth is what it is.
static void proof_push_outs_are_true(void) {
  shapes_rng rng = {91};
  size_t asked = 0;
  size_t lifted = 0;
  size_t free_then = 0;
  size_t wrong = 0;
  size_t deep = 0;
  size_t too_short = 0;
  size_t too_long = 0;
  size_t unsafe = 0;
  const size_t wanted = check_many(600);
  while (asked < wanted) {
    attack a;
    proof_any_two(&rng, &a);
    const double size = a.moving->size + a.fixed->size;
    const float skin = (float)(size * pow(10, shapes_uniform(&rng, -4, -2)));
    const double gap = shapes_uniform(&rng, -0.5, 0.5) * (double)skin / size;
    nsvcd_question options = proof_options();
    oracle_pose fixed, pose, poses[PROOF_POSES];
    double point[3], away[3], lift[3];
    shapes_quaternion(&rng, fixed.rotation);
    for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(&rng, -1, 1) * size;
    if (!proof_near_contact(&rng, &a, &fixed, gap * size, &pose, point, away)) continue;
    for (int n = 0; n < 3; n++) {  // away from it, and a little along
      poses[n] = pose;
      for (int k = 0; k < 3; k++)
        poses[n].position[k] += 0.1 * n * size * (away[k] + 0.5 * away[(k + 1) % 3]);
    }
    proof_motion_set(&a.motion, poses, 3, &fixed);
    if (shapes_pick(&rng, 2)) proof_carry(&rng, &a, 1, size);
    options.slop = skin;
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    for (int k = 0; k < 3; k++) lift[k] = (double)a.answer.push_out[k];
    asked++;
    const double length = oracle_length(lift);
    lifted += length > 0;
    CHECK_LE(length, 4.001 * (double)skin);
    if (length > 0 && length < 1.001 * (double)skin) {
      deep++;
      proof_check_depth(&a, lift, &too_short, &too_long);
    }
    if (length > 0 && !a.answer.inside) unsafe += !proof_is_safe(&a);
    if (a.answer.verdict != NSVCD_FREE) continue;
    free_then++;
    for (int k = 0; k <= 20; k++) wrong += !(proof_lifted_distance(&a, lift, k / 20.0) > 0);
  }
  printf("  %zu bodies that touch: %zu lifted, %zu free then; %zu wrong\n", asked, lifted,
         free_then, wrong);
  printf("  %zu depths, %zu too short, %zu too long; %zu places not safe\n", deep, too_short,
         too_long, unsafe);
  CHECK_EQ(wrong, 0);
  CHECK_EQ(unsafe, 0);
  CHECK_EQ(too_short, 0);
  // of lifts that several normals, nearly parallel, make
  CHECK_LE(too_long, 1 + deep / 200);
  CHECK_GE(lifted, asked / 3);
  CHECK_GE(free_then, asked / 4);
}

// -------------------------------------------------------------------------------------------------
// containment

typedef struct within_sum {
  size_t asked, inside, free, undecided, witness, wrong, far_undecided;
} within_sum;

// One placement, against winding numbers. `encloses`: by their makers' word neither body is open.
static void proof_place_within(attack *a, shapes_rng *rng, double gap, int moving_open,
                               int fixed_open, within_sum *sum) {
  const double size = a->moving->size + a->fixed->size;
  oracle_pose fixed, pose;
  double point[3], away[3];
  shapes_quaternion(rng, fixed.rotation);
  for (int k = 0; k < 3; k++) fixed.position[k] = shapes_uniform(rng, -1, 1) * size;
  if (!proof_near_contact(rng, a, &fixed, gap * size, &pose, point, away)) return;
  // with two, the library looks at it from `fixed`, even if that is the smaller
  const oracle_pose still[2] = {pose, pose};
  proof_motion_set(&a->motion, still, shapes_pick(rng, 2) ? 1 : 2, &fixed);
  const oracle_pose *at = &a->motion.moving.poses[0];
  const oracle_mesh *x = &a->moving->oracle;
  const oracle_mesh *y = &a->fixed->oracle;
  const double distance = oracle_distance(x, at, y, &a->motion.fixed.poses[0], NULL, NULL);
  if (distance < 1e-9 * size) return;
  const double moving_within = fixed_open ? 0 : oracle_inside(x, at, y, &a->motion.fixed.poses[0]);
  const double fixed_within = moving_open ? 0 : oracle_inside(y, &a->motion.fixed.poses[0], x, at);
  const int within = fmax(moving_within, fixed_within) > 0.5;
  proof_ask(a);
  const status said = status_of(&a->answer);
  sum->asked++;
  sum->inside += said == STATUS_INSIDE;
  sum->free += said == STATUS_CERTIFIED_FREE;
  sum->undecided += said == STATUS_UNDECIDED;
  sum->witness += said == STATUS_WITNESS;
  sum->wrong += said == STATUS_INSIDE && !within;
  sum->wrong += said == STATUS_CERTIFIED_FREE && within;
  sum->far_undecided +=
      said != STATUS_INSIDE && said != STATUS_CERTIFIED_FREE && distance > 1e-4 * size;
  if (said == STATUS_WITNESS) proof_check_witness(a);
}

static proof_body proof_of_shape(shapes_mesh *shape, size_t points) {
  const nsvcd_encode_options options = {.patches = points};
  return proof_encode(shape, 1, &options);
}

// Two boxes apart from each other: of one body a part can be within.
static proof_body proof_two_boxes(double edge, double apart, size_t points) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box_at(&shape, -apart / 2, 0, 0, edge, edge, edge);
  shapes_box_at(&shape, apart / 2, 0, 0, edge, 0.8 * edge, 0.7 * edge);
  return proof_of_shape(&shape, points);
}

// A ball inside out: by its winding number -1 it encloses as well.
static proof_body proof_inverted_ball(void) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_ellipsoid(&shape, 0.2, 0.2, 0.2, 12);
  shapes_flip(&shape, 0);
  return proof_of_shape(&shape, 20);
}

static void proof_knows_what_is_within(void) {
  enum { OUTER = 10, INNER = 6 };
  proof_body inner[INNER], outer[3];
  shapes_rng rng = {8};
  const proof_body *outers[OUTER];
  within_sum near = {0, 0, 0, 0, 0, 0, 0};
  within_sum any = near;
  inner[0] = proof_make(BOX, 1, 8, 0.05);
  inner[1] = proof_make(SOLID, 5, 16, 0.1);
  inner[2] = proof_make(TRIANGLE, 1, 1, 0.01);
  inner[3] = proof_two_boxes(0.01, 0.3, 12);
  inner[4] = proof_make(BALL, 1, 12, 0.02);
  inner[5] = proof_make(SHELL, 2, 30, 0.3);
  outer[0] = proof_two_boxes(0.3, 0.5, 40);
  outer[1] = proof_inverted_ball();
  outer[2] = proof_make(SHEET, 1, 20, 2);
  for (int k = 0; k < 3; k++) outers[k] = &outer[k];
  for (int k = 3; k < OUTER; k++) {
    static const size_t shared[OUTER - 3] = {0, 2, 4, 9, 6, 13, 17};
    outers[k] = proof_shared(0, shared[k - 3]);
  }
  for (size_t trial = 0; trial < check_many(4000); trial++) {
    attack a;
    const int i = shapes_pick(&rng, INNER);
    const int o = shapes_pick(&rng, OUTER);
    const int swapped = shapes_pick(&rng, 2);
    const int close = shapes_pick(&rng, 2);
    const double gap =
        close ? pow(10, shapes_uniform(&rng, -7, -4)) : pow(10, shapes_uniform(&rng, -4, -1));
    a.moving = swapped ? outers[o] : &inner[i];
    a.fixed = swapped ? &inner[i] : outers[o];
    proof_place_within(&a, &rng, gap, swapped ? o == 2 : i == 2, swapped ? i == 2 : o == 2,
                       close ? &near : &any);
  }
  for (int k = 0; k < 2; k++) {
    const within_sum *sum = k ? &near : &any;
    printf(
        "  %s: %zu placements: inside %zu, free %zu, undecided %zu (%zu of them far), witness %zu, "
        "wrong %zu\n",
        k ? "within a hair" : "anywhere", sum->asked, sum->inside, sum->free, sum->undecided,
        sum->far_undecided, sum->witness, sum->wrong);
    CHECK_EQ(sum->wrong, 0);
    CHECK_GE(sum->inside, sum->asked / 20);
  }
  CHECK_EQ(any.far_undecided, 0);
  for (int k = 0; k < INNER; k++) proof_free(&inner[k]);
  for (int k = 0; k < 3; k++) proof_free(&outer[k]);
}

// As nsvcd__cross_all, of closed surfaces, but all triangles of a patch whose sphere the ray meets are asked in double.
static int proof_crossings(const nsvcd__geometry *f, const nsvcd__ray *ray, int *unclear) {
  static uint32_t crossed[1000];
  const nsvcd__beam beam = {nsvcd__f3_round(ray->from), nsvcd__f3_round(ray->direction),
                            ray->rounding};
  size_t count = 0;
  int sum = 0;
  for (size_t i = 0; i < f->body->patches; i++) {
    const size_t first = i / NSVCD__GROUP * NSVCD__GROUP;
    const nsvcd__spheres members = nsvcd__spheres_from(nsvcd__body_patches(f->body), first);
    if (!(nsvcd__is_on_beam(&beam, members) >> (i - first) & 1)) continue;
    nsvcd__numbers numbers = nsvcd__numbers_of(f, i);
    for (size_t n = f->first_triangle[i]; n < f->first_triangle[i + 1]; n++) {
      nsvcd__d3 corners[3];
      nsvcd__read_number(&numbers, n);
      if (numbers.kind != NSVCD__CLOSED) continue;
      nsvcd__patch_triangle(f, i, n, corners);
      const int crossing = nsvcd__ray_crosses(ray, corners, ray->margin, unclear);
      size_t known = 0;
      while (known < count && crossed[known] != numbers.number) known++;
      if (!crossing || known < count || count == 1000) continue;
      crossed[count++] = numbers.number;
      sum += crossing;
    }
  }
  return sum;
}

// A ray from somewhere about a body that passes close to an edge.
static nsvcd__ray proof_ray_at_edge(shapes_rng *rng, const nsvcd__geometry *f, double margin) {
  const size_t entry = shapes_next(rng) % f->counts->listed;
  const double radius = (double)f->body->radius;
  size_t patch = 0;
  nsvcd__d3 t[3];
  nsvcd__ray ray;
  while (f->first_triangle[patch + 1] <= entry) patch++;
  nsvcd__patch_triangle(f, patch, entry, t);
  const nsvcd__d3 aim = nsvcd__d3_mix(t[0], t[1], shapes_uniform(rng, 0, 1));
  const double sign = shapes_pick(rng, 2) ? 1 : -1;
  const double off = sign * pow(10, shapes_uniform(rng, -15, -1));
  const nsvcd__d3 to = nsvcd__d3_fma(off, nsvcd__d3_sub(t[2], aim), aim);
  const nsvcd__d3 away = nsvcd__d3_of(shapes_uniform(rng, -1, 1), shapes_uniform(rng, -1, 1),
                                      shapes_uniform(rng, -1, 1));
  ray.from = nsvcd__d3_fma(radius, away, nsvcd__d3_load(f->body->centre));
  ray.direction = nsvcd__d3_unit(nsvcd__d3_sub(to, ray.from), nsvcd__d3_of(0, 0, 1));
  ray.margin = margin;
  ray.rounding = (float)margin + 4 * NSVCD__ROUNDING * f->body->extent;
  return ray;
}

// Rays that pass close to edges: what is left out in floats is nothing in double. Of a fine ball,
// also far from its origin.
static void proof_rays_miss_nothing(void) {
  nsvcd__query *query = any_query();
  shapes_rng rng = {92};
  for (int n = 0; n < 3; n++) {
    size_t clear = 0;
    size_t wrong = 0;
    shapes_mesh shape;
    memset(&shape, 0, sizeof shape);
    shapes_ellipsoid(&shape, 0.02, 0.02, 0.02, 40);
    shapes_place(&shape, 0, NULL, n == 0 ? 0 : 3, n == 2 ? 100 : 0, 1);
    proof_body ball = proof_of_shape(&shape, 256);
    const nsvcd__geometry f = nsvcd__geometry_of(nsvcd__triangles_of(ball.body));
    for (int trial = 0; trial < 6000; trial++) {
      const nsvcd__ray ray = proof_ray_at_edge(&rng, &f, 1e-13);
      int unclear_in_double = 0;
      const nsvcd__crossings sum = nsvcd__cross_all(query->solver, &f, &ray);
      const int in_double = proof_crossings(&f, &ray, &unclear_in_double);
      clear += !unclear_in_double;
      wrong += sum.unclear != unclear_in_double;
      wrong += !sum.unclear && sum.winds != in_double;
    }
    printf("  %zu rays of 6000 clear of edges, %zu wrong\n", clear, wrong);
    CHECK_EQ(wrong, 0);
    CHECK(clear > 300 && clear < 5700);
    proof_free(&ball);
  }
  free(query);
}

// A cube in a room, nearer to its walls than the tolerance at the start, which then goes on to
// meet one, or not: what is said is about the start.
static void proof_says_where_inside(void) {
  shapes_mesh shape;
  attack a;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 1, 1, 1, 1);
  proof_body room = proof_of_shape(&shape, 0);
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 0.1, 0.1, 0.1, 1);
  proof_body cube = proof_of_shape(&shape, 0);
  const oracle_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
  for (int n = 0; n < 6; n++) {
    const int meets = n % 2;
    nsvcd_question options = proof_options();
    const oracle_pose poses[2] = {{{-0.447, -0.447, -0.447}, {0, 0, 0, 1}},
                                  {{meets ? 1 : 0, 0, 0}, {0, 0, 0, 1}}};
    a.moving = &cube;
    a.fixed = &room;
    proof_motion_set(&a.motion, poses, 2, &fixed);
    if (n < 4)
      proof_ask_first(&options, 0.01f);
    else
      proof_ask_distance(&options, 1e-3f);
    options.tolerance = n < 2 ? 0 : 0.02f;
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    if (n == 5) {  // the nearest is sought first
      CHECK_EQ(status_of(&a.answer), STATUS_WITNESS);
      continue;
    }
    CHECK_EQ(status_of(&a.answer), STATUS_INSIDE);
    CHECK_EQ(a.answer.nearest.time, 0);
    CHECK_EQ(a.answer.nearest.triangle_a, NSVCD_NO_TRIANGLE);
    CHECK_EQ(a.answer.nearest.triangle_b, NSVCD_NO_TRIANGLE);
    for (int k = 0; k < 3; k++) {
      CHECK_EQ(a.answer.nearest.normal[k], 0);
      CHECK_LE(fabs((double)a.answer.nearest.point[k] + 0.447), 0.0501);
    }
  }
  proof_free(&room);
  proof_free(&cube);
}

// -------------------------------------------------------------------------------------------------
// limits, options

static int proof_same_answer(const nsvcd_answer *a, const nsvcd_answer *b) {
  const nsvcd_contact *x = &a->nearest;
  const nsvcd_contact *y = &b->nearest;
  return a->verdict == b->verdict && a->by == b->by && a->why == b->why && a->inside == b->inside &&
         a->work == b->work && memcmp(&a->time, &b->time, sizeof a->time) == 0 &&
         memcmp(&x->time, &y->time, sizeof x->time) == 0 &&
         memcmp(x->point, y->point, sizeof x->point) == 0 &&
         memcmp(x->normal, y->normal, sizeof x->normal) == 0 && x->triangle_a == y->triangle_a &&
         x->triangle_b == y->triangle_b && x->patch_a == y->patch_a && x->patch_b == y->patch_b;
}

// Which body is a and which b does not matter: the other way round everything is said the other way
// round, and nothing else.
static void proof_sides_do_not_matter(void) {
  shapes_rng rng = {25};
  size_t witnesses_seen = 0;
  for (size_t trial = 0; trial < 300; trial++) {
    nsvcd_question options = proof_options();
    attack a;
    nsvcd_answer other;
    if (!proof_timing_scene(&rng, &a)) continue;
    a.motion.moving.scale = trial % 3 ? 1 : 1.2f;
    a.motion.fixed.scale = trial % 5 ? 1 : 0.7f;
    if (trial % 2) proof_ask_first(&options, 0.01f);
    if (trial % 7 == 0) options.clearance = 0.003f;
    if (trial % 4 == 0) options.slop = 0.001f;
    const nsvcd_question question = proof_question(&a, &options);
    nsvcd_question turned = question;
    turned.a = question.b;
    turned.b = question.a;
    const size_t size = nsvcd_sweep_workspace_size(NULL);
    CHECK_EQ(nsvcd_sweep(&question, proof_workspace(), size, &a.answer), NSVCD_OK);
    CHECK_EQ(nsvcd_sweep(&turned, proof_workspace(), size, &other), NSVCD_OK);
    const uint32_t triangle = other.nearest.triangle_a;
    const uint32_t patch = other.nearest.patch_a;
    other.nearest.triangle_a = other.nearest.triangle_b;
    other.nearest.triangle_b = triangle;
    other.nearest.patch_a = other.nearest.patch_b;
    other.nearest.patch_b = patch;
    for (int k = 0; k < 3; k++) {
      CHECK_EQ(a.answer.push_out[k], 0 - other.push_out[k]);
      other.nearest.normal[k] = 0 - other.nearest.normal[k] + 0.0f;
      a.answer.nearest.normal[k] += 0.0f;  // no zero with a sign
      // the place is on b, whichever that is
      const nsvcd_contact *c = &a.answer.nearest;
      const float gap = c->gap < HUGE_VALF ? c->gap : 0;
      const float on_a = c->point[k] + gap * c->normal[k];
      CHECK_NEAR(other.nearest.point[k], on_a, 1e-6 * (fabs((double)on_a) + 1));
      other.nearest.point[k] = c->point[k];
    }
    CHECK(proof_same_answer(&a.answer, &other));
    CHECK_EQ(a.answer.time.low, other.time.low);
    if (status_of(&a.answer) != STATUS_WITNESS || !(options.clearance > 0) || options.slop > 0)
      continue;
    // The normal goes from b to a: along it a leaves b.
    const oracle_pose pose = proof_pose_at(&a.motion.moving, (double)a.answer.nearest.time);
    const oracle_pose fixed = proof_pose_at(&a.motion.fixed, (double)a.answer.nearest.time);
    const oracle_triangle x = proof_world_triangle(a.moving, a.answer.nearest.triangle_a, &pose,
                                                   (double)a.motion.moving.scale);
    const oracle_triangle y = proof_world_triangle(a.fixed, a.answer.nearest.triangle_b, &fixed,
                                                   (double)a.motion.fixed.scale);
    oracle_triangle away = x;
    for (int k = 0; k < 9; k++)
      away.v[k / 3][k % 3] += 0.002 * (double)a.answer.nearest.normal[k % 3];
    if (proof_triangle_distance(&x, &y) < 1e-4) continue;
    witnesses_seen++;
    CHECK_GE(proof_triangle_distance(&away, &y), proof_triangle_distance(&x, &y) + 0.0015);
  }
  CHECK_GE(witnesses_seen, 5);
}

// With any limit: what is said is what is said without one, or nothing; and the limit is not passed
// by much.
static void proof_keeps_its_limit(void) {
  shapes_rng rng = {22};
  attack a;
  size_t asked = 0;
  size_t undecided = 0;
  size_t most = 0;
  size_t other = 0;
  for (size_t trial = 0; trial < 150; trial++) {
    nsvcd_question options = proof_options();
    proof_any_two(&rng, &a);
    if (!proof_scene(&rng, &a, pow(10, shapes_uniform(&rng, -6, -1)), 1)) continue;
    options.work = 100000000;
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    const nsvcd_answer full = a.answer;
    for (options.work = 1; options.work < 100000; options.work += 1 + options.work / 2) {
      CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
      const size_t over = a.answer.work > options.work ? a.answer.work - options.work : 0;
      asked++;
      most = over > most ? over : most;
      undecided += a.answer.verdict == NSVCD_UNDECIDED;
      // what is inside is known to meet as well only if there is work for that
      const status now = status_of(&a.answer);
      const int less = now == STATUS_INSIDE && status_of(&full) == STATUS_WITNESS;
      other += now != STATUS_UNDECIDED && now != status_of(&full) && !less;
      CHECK(a.answer.verdict != NSVCD_FREE || full.verdict == NSVCD_FREE);
      CHECK(a.answer.verdict != NSVCD_FREE || over == 0);
    }
  }
  printf("  %zu limits: undecided %zu, another verdict %zu; at most %zu units beyond the limit\n",
         asked, undecided, other, most);
  CHECK_EQ(other, 0);
  CHECK_LE(most, 10000);
}

// Many triangles in one patch, and many components: what a limit has to hold back. A ray looks at
// all of a body.
static void proof_keeps_its_limit_in_large_patches(void) {
  shapes_rng rng = {24};
  shapes_mesh shape;
  size_t most = 0;
  memset(&shape, 0, sizeof shape);
  shapes_ellipsoid(&shape, 0.11, 0.1, 0.1, 80);
  proof_body ball = proof_of_shape(&shape, 1);
  memset(&shape, 0, sizeof shape);
  for (int k = 0; k < 300; k++) {
    double d[3];
    shapes_direction(&rng, d);
    shapes_box_at(&shape, 0.02 * d[0], 0.02 * d[1], 0.02 * d[2], 0.001, 0.001, 0.001);
  }
  proof_body crumbs = proof_of_shape(&shape, 16);
  nsvcd_question options = proof_options();
  options.work = 1000;
  for (int trial = 0; trial < 40; trial++) {
    attack a;
    a.moving = trial % 2 ? &ball : &crumbs;
    a.fixed = &ball;
    if (!proof_scene(&rng, &a, 1e-3, 0)) continue;
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    most = a.answer.work > most ? a.answer.work : most;
  }
  printf("  %zu triangles in a patch, 300 components: at most %zu units, of 1000\n", ball.triangles,
         most);
  CHECK_LE(most, options.work + 2 * (ball.listed + crumbs.listed));

  // On itself no ray is clear: one of them may be beyond the limit, not all eight. It looks at all
  // triangles by sixteens, and at those that it comes near, a hundred here, one by one.
  attack itself;
  const oracle_pose still = {{0, 0, 0}, {0, 0, 0, 1}};
  options.work = 1;
  itself.moving = itself.fixed = &ball;
  proof_motion_set(&itself.motion, &still, 1, &still);
  CHECK_EQ(proof_ask_with(&itself, &options), NSVCD_OK);
  CHECK_EQ(itself.answer.verdict, NSVCD_UNDECIDED);
  CHECK_LE(itself.answer.work, 1 + ball.listed / 16 + 1 + 100);
  proof_free(&ball);
  proof_free(&crumbs);
}

// A crate that slides on a coarse floor so closely that it cannot be told apart from it: of the work
// allowed an eighth is left from the first doubt on, whatever is asked.
static void proof_in_doubt_ends_soon(void) {
  enum { GAPS = 40 };
  shapes_rng rng = {418};
  attack a;
  proof_body crate = proof_crate(6);
  const nsvcd_encode_options coarse = {.coarse = 1};
  proof_body floor = proof_floor_with(&coarse, 0, 8);
  const double quantum = (double)nsvcd_body_describe(floor.body).quantization_error;
  size_t undecided = 0;
  size_t most = 0;
  a.moving = &crate;
  a.fixed = &floor;
  for (int n = 0; n < GAPS; n++) {
    const double gap = quantum * (0.2 + 2.0 * n / GAPS);
    const nsvcd_answer answer = proof_push(&a, &rng, -0.3, 0.3, gap, gap, 0, 0, n % 2 ? 0.001f : 0);
    undecided += answer.verdict == NSVCD_UNDECIDED;
    most = answer.work > most ? answer.work : most;
    // where less is left than that, it is not more afterwards
    nsvcd_question options = proof_options();
    for (options.work = 500; options.work < 8000; options.work += 500) {
      CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
      CHECK_LE(a.answer.work, options.work + 50);
    }
  }
  printf("  %d slides: %zu undecided, at most %zu units\n", GAPS, undecided, most);
  CHECK_GE(undecided, GAPS / 4);
  CHECK_LE(most, NSVCD_DEFAULT_WORK / 5);
  CHECK_GE(most, NSVCD_DEFAULT_WORK / 8);
  proof_free(&crate);
  proof_free(&floor);
}

// What turns on the tip of one leg on a coarse floor, which slopes: its stored points are on both sides
// of the floor's own plane, farther off than rounding. Other legs end a little above that plane: what
// separates one of these may seem to separate the one that stands. Both are open: what is within
// another is asked about each leg by itself, with other planes.
static void proof_turning_on_a_coarse_floor_is_never_free(void) {
  enum { LEGS = 8 };
  const size_t trials = check_many(600);
  shapes_rng rng = {419};
  size_t verdicts[3] = {0};
  for (size_t n = 0; n < trials; n++) {
    const nsvcd_encode_options options = {.patches = 1 + n % 3, .open = 1, .coarse = 1};
    shapes_mesh shapes[2];
    memset(shapes, 0, sizeof shapes);
    shapes_box_at(&shapes[0], 0, 0, -0.1, 2, 2, 0.2);
    for (size_t k = 0; k < LEGS; k++) {
      const double reach = k == n % LEGS ? 0 : 0.4;
      const double x = shapes_uniform(&rng, -reach, reach);
      const double y = shapes_uniform(&rng, -reach, reach);
      const double z = reach > 0 ? pow(10, shapes_uniform(&rng, -4.5, -3.5)) : 0;
      const uint32_t tip = shapes_vertex(&shapes[1], x, y, z);
      uint32_t top[3];
      for (int i = 0; i < 3; i++)
        top[i] = shapes_vertex(&shapes[1], x + 0.1 * cos(2.1 * i), y + 0.1 * sin(2.1 * i), z + 0.3);
      for (int i = 0; i < 3; i++) shapes_triangle(&shapes[1], tip, top[(i + 1) % 3], top[i]);
      shapes_triangle(&shapes[1], top[0], top[1], top[2]);
    }
    double turn[4], m[9], stand[3];
    proof_body bodies[2];
    shapes_quaternion(&rng, turn);
    oracle_matrix(turn, m);
    for (int b = 0; b < 2; b++) {
      for (size_t i = 0; i < shapes[b].vertices; i++) {
        double x[3];
        memcpy(x, shapes[b].positions + 3 * i, sizeof x);
        oracle_rotate(m, x, shapes[b].positions + 3 * i);
      }
      bodies[b] = proof_encode(&shapes[b], 1, &options);
    }
    const double up[3] = {0, 0, 1};
    const oracle_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
    const double at[3] = {shapes_uniform(&rng, -0.5, 0.5), shapes_uniform(&rng, -0.5, 0.5), -2e-7};
    double axis[3];
    oracle_rotate(m, up, axis);
    oracle_rotate(m, at, stand);
    oracle_pose poses[2];
    const double angle = shapes_uniform(&rng, 0.02, 0.13);
    for (int k = 0; k < 2; k++) {
      memcpy(poses[k].position, stand, sizeof stand);
      oracle_axis_angle(axis, k * angle, poses[k].rotation);
    }
    attack a;
    a.moving = &bodies[1];
    a.fixed = &bodies[0];
    proof_motion_set(&a.motion, poses, 2, &fixed);
    proof_ask(&a);
    verdicts[a.answer.verdict]++;
    proof_free(&bodies[0]);
    proof_free(&bodies[1]);
  }
  printf("  %zu turns: hit %zu, undecided %zu\n", trials, verdicts[NSVCD_HIT],
         verdicts[NSVCD_UNDECIDED]);
  CHECK_EQ(verdicts[NSVCD_FREE], 0);
}

// What kinds of questions cost, in units of work: nothing is as quick to notice that a filter lets
// all pass, or an order is the wrong way round, whose answers are as right as before.
typedef enum cost_kind {
  COST_VERDICT,
  COST_FIRST,
  COST_CLEARANCE,
  COST_MEASURE,
  COST_SKIN,
  COST_INSIDE,
  COSTS
} cost_kind;

static nsvcd_question proof_cost_options(cost_kind kind, double size) {
  nsvcd_question options = proof_options();
  options.work = 3000;  // what is undecided shall not outweigh the rest
  if (kind == COST_FIRST) proof_ask_first(&options, 0.001f);
  options.clearance = kind == COST_CLEARANCE ? (float)(0.01 * size) : 0;
  if (kind == COST_MEASURE) proof_ask_distance(&options, (float)(0.001 * size));
  options.slop = kind == COST_SKIN ? (float)(0.001 * size) : 0;
  return options;
}

// The moving body becomes a small one within the fixed one's ball, at rest.
static void proof_shrink_into(shapes_rng *rng, attack *a) {
  const oracle_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
  oracle_pose pose;
  shapes_quaternion(rng, pose.rotation);
  for (int k = 0; k < 3; k++) pose.position[k] = shapes_uniform(rng, -0.4, 0.4) * a->fixed->size;
  proof_motion_set(&a->motion, &pose, 1, &fixed);
  a->motion.moving.scale = (float)(0.05 * a->fixed->size / a->moving->size);
}

// Work is counted, not timed: it is the same on any machine but for rounding. Where a change makes
// it less, the new sums belong here. Small tiles are searched in another order.
static void proof_takes_no_more_work(void) {
  static const struct {
    const char *name;
    double most;
  } known[COSTS] = {{"verdict", 56648},         {"first contact", 69860}, {"clearance", 14085},
                    {"least distance", 108803}, {"skin", 61982},          {"inside", 57853}};
  size_t sums[COSTS] = {0};
  shapes_rng rng = {417};
  for (size_t scenes = 0; scenes < 400;) {
    attack a;
    proof_any_two(&rng, &a);
    const double gap = shapes_pick(&rng, 3) ? pow(10, shapes_uniform(&rng, -4, -1)) : -0.02;
    if (!proof_scene(&rng, &a, gap, 0.3)) continue;
    const double size = a.moving->size + a.fixed->size;
    a.motion.moving.timed = 0;
    scenes++;
    for (int kind = 0; kind < COSTS; kind++) {
      const nsvcd_question options = proof_cost_options((cost_kind)kind, size);
      if (kind == COST_INSIDE) proof_shrink_into(&rng, &a);
      CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
      sums[kind] += a.answer.work;
    }
  }
  for (int kind = 0; kind < COSTS; kind++) {
    printf("  %s: %zu units of work, %.4f of what is known\n", known[kind].name, sums[kind],
           (double)sums[kind] / known[kind].most);
    CHECK_LE((double)sums[kind], (NSVCD__TILE < 32 ? 1.07 : 1.03) * known[kind].most);
  }
}

// -------------------------------------------------------------------------------------------------
// budgets

// A bowl: part of a sphere, as thick as a twentieth of its radius.
static proof_body proof_bowl(int segments) {
  enum { RINGS = 40 };
  double profile[2 * RINGS][2];
  for (int k = 0; k < RINGS; k++) {
    const double angle = 1.35 * k / (RINGS - 1);
    for (int inner = 0; inner < 2; inner++) {
      const int at = inner ? 2 * RINGS - 1 - k : k;
      const double radius = inner ? 0.095 : 0.1;
      profile[at][0] = radius * sin(angle);
      profile[at][1] = 0.1 - radius * cos(angle);
    }
  }
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_lathe(&shape, (const double(*)[2])profile, 2 * RINGS, segments, 0);
  return proof_of_shape(&shape, 0);
}

// The attack of a bowl that goes down in another one, from one height to another, as it turns.
static void proof_bowl_falls(attack *a, double from, double to, double turn) {
  const oracle_pose fixed = {{0, 0, 0}, {0, 0, 0, 1}};
  const oracle_pose poses[2] = {{{0, 0, from}, {0, 0, 0, 1}},
                                {{0, 0, to}, {0, 0, sin(turn / 2), cos(turn / 2)}}};
  proof_motion_set(&a->motion, poses, 2, &fixed);
}

#define BUDGETS 11
static const size_t proof_budgets[BUDGETS] = {250,   500,   1000,  2000,   4000,  8000,
                                              12000, 16000, 32000, 100000, 400000};

// Is all answered that was asked, by the search itself: is the last share of the work untouched?
static int proof_is_answered(const nsvcd_answer *answer, size_t work) {
  return answer->verdict != NSVCD_UNDECIDED && !answer->why && answer->work <= work - work / 8;
}

// The limit is no part of the schedule: what a lower one has decided takes as many units with a
// higher one, and the answer is the same to the bit.
static void proof_takes_no_more_for_a_higher_limit(attack *a, nsvcd_question options,
                                                   size_t *answered) {
  nsvcd_answer first;
  int is_answered = 0;
  for (size_t n = 0; n < BUDGETS; n++) {
    options.work = proof_budgets[n];
    CHECK_EQ(proof_ask_with(a, &options), NSVCD_OK);
    if (is_answered) {
      CHECK_EQ(a->answer.work, first.work);
      CHECK_EQ(a->answer.verdict, first.verdict);
      CHECK_EQ(memcmp(&a->answer.time, &first.time, sizeof first.time), 0);
      CHECK_EQ(memcmp(&a->answer.nearest, &first.nearest, sizeof first.nearest), 0);
    } else if (proof_is_answered(&a->answer, options.work)) {
      first = a->answer;
      is_answered = 1;
    }
  }
  *answered += (size_t)is_answered;
}

static void proof_higher_limits_take_no_more_work(void) {
  static const cost_kind kinds[3] = {COST_VERDICT, COST_FIRST, COST_CLEARANCE};
  shapes_rng rng = {733};
  size_t answered = 0;
  size_t long_ones = 0;
  for (int scenes = 0; scenes < 60;) {
    attack a;
    proof_any_two(&rng, &a);
    if (!proof_scene(&rng, &a, pow(10, shapes_uniform(&rng, -5, -2)), 0.3)) continue;
    scenes++;
    for (int n = 0; n < 3; n++) {
      const nsvcd_question options = proof_cost_options(kinds[n], a.moving->size + a.fixed->size);
      proof_takes_no_more_for_a_higher_limit(&a, options, &answered);
    }
  }
  // of many small triangles, near each other all the while
  proof_body bowl = proof_bowl(64);
  for (int n = 0; n < 4; n++) {
    attack a;
    a.moving = a.fixed = &bowl;
    proof_bowl_falls(&a, n % 2 ? 0.06 : 0.03, 0.0167 + 0.0002 * n, 0);
    for (int kind = 0; kind < 2; kind++) {
      const nsvcd_question options = proof_cost_options(kinds[kind], 0.2);
      proof_takes_no_more_for_a_higher_limit(&a, options, &answered);
      long_ones += a.answer.work > 6000;
    }
  }
  printf("  %zu of 188 answered, %zu of the bowls' after 6,000 units and more\n", answered,
         long_ones);
  CHECK_GE(answered, 150);
  CHECK_GE(long_ones, 3);
  proof_free(&bowl);
}

// What is proven when the work ends is told: of a fall that starts clear, more the more work there
// is, whatever else is asked; nothing only where there is hardly work for the start.
static void proof_tells_more_with_more_work(void) {
  proof_body bowl = proof_bowl(48);
  size_t early = 0;
  for (int kind = 0; kind < 8; kind++) {
    attack a;
    nsvcd_answer whole;
    nsvcd_question options = proof_options();
    size_t least = 0;
    float low = 0;
    a.moving = a.fixed = &bowl;
    proof_bowl_falls(&a, 0.05, 0.0055, kind & 4 ? 0.2 : 0);
    proof_ask_first(&options, 1e-4f);
    options.manifold = kind & 1;
    options.slop = kind & 2 ? 1e-4f : 0;
    options.clearance = kind & 2 ? 0 : 1e-3f;
    options.work = 1000000;
    CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
    whole = a.answer;
    CHECK_EQ(whole.verdict, NSVCD_HIT);
    for (options.work = 500; options.work < whole.work; options.work += options.work / 4) {
      CHECK_EQ(proof_ask_with(&a, &options), NSVCD_OK);
      CHECK_GE(a.answer.time.low, low - 2e-4f);
      CHECK_LE(a.answer.time.low, whole.time.high);
      low = fmaxf(low, a.answer.time.low);
      if (low > 0 && !least) least = options.work;
    }
    printf("  %d: %zu units, something known with %zu\n", kind, whole.work, least);
    early += least > 0 && 3 * least < whole.work;
  }
  CHECK_EQ(early, 8);
  proof_free(&bowl);
}

// -------------------------------------------------------------------------------------------------
// special scenes

static status proof_ask_place(attack *a, const oracle_pose *pose, const oracle_pose *fixed) {
  proof_motion_set(&a->motion, pose, 1, fixed);
  proof_ask(a);
  return status_of(&a->answer);
}

// A body on itself: all surfaces meet. A little off, they cross.
static void proof_bodies_on_themselves(void) {
  shapes_rng rng = {61};
  size_t verdicts[6] = {0, 0, 0, 0, 0, 0};
  size_t off[6] = {0, 0, 0, 0, 0, 0};
  for (size_t n = 0; n < MAKES; n++) {
    attack a;
    oracle_pose pose, moved;
    a.moving = a.fixed = proof_shared(0, n);
    for (int trial = 0; trial < 20; trial++) {
      const double shift = a.moving->size * pow(10, shapes_uniform(&rng, -8, -2));
      double d[3];
      proof_random_rotation(&rng, trial % 2, pose.rotation);
      shapes_direction(&rng, d);
      for (int k = 0; k < 3; k++) pose.position[k] = (double)(trial % 3) * d[k];
      verdicts[proof_ask_place(&a, &pose, &pose)]++;
      moved = pose;
      for (int k = 0; k < 3; k++) moved.position[k] += shift * d[(k + 1) % 3];
      proof_ask_place(&a, &moved, &pose);
      if (oracle_distance(&a.moving->oracle, &a.motion.moving.poses[0], &a.fixed->oracle,
                          &a.motion.fixed.poses[0], NULL, NULL) > 0)
        continue;
      off[status_of(&a.answer)]++;
    }
  }
  printf(
      "  in place: witness %zu, inside %zu, undecided %zu, free %zu; off: witness %zu, inside %zu, "
      "undecided %zu, "
      "free %zu\n",
      verdicts[STATUS_WITNESS], verdicts[STATUS_INSIDE], verdicts[STATUS_UNDECIDED],
      verdicts[STATUS_CERTIFIED_FREE], off[STATUS_WITNESS], off[STATUS_INSIDE],
      off[STATUS_UNDECIDED], off[STATUS_CERTIFIED_FREE]);
  CHECK_EQ(verdicts[STATUS_CERTIFIED_FREE], 0);
  CHECK_EQ(off[STATUS_CERTIFIED_FREE], 0);
}

// A flat sheet of this size, open, its corners representable.
static proof_body proof_flat_sheet(double x, double y, int cuts) {
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  proof_sheet(&shape, 1, cuts);
  for (size_t i = 0; i < shape.vertices; i++) {
    shape.positions[3 * i] *= x;
    shape.positions[3 * i + 1] *= y;
    shape.positions[3 * i + 2] = 0;
  }
  return proof_of_shape(&shape, 16);
}

// Sheets that are parallel all the time, one of which passes through the other: they meet at a
// single time, which no rounded number is. By a corner in a face (0), a face on a corner (1), edges
// over edges (2); past it (3); and there and back, short of it by a hair (4).
static void proof_faces_pass(void) {
  shapes_rng rng = {91};
  proof_body small = proof_flat_sheet(0.125, 0.125, 2);
  proof_body large = proof_flat_sheet(0.5, 0.5, 2);
  proof_body wide = proof_flat_sheet(0.5, 0.03125, 1);
  proof_body deep = proof_flat_sheet(0.03125, 0.5, 1);
  const proof_body *moving[5] = {&small, &large, &wide, &small, &small};
  const proof_body *fixed[5] = {&large, &small, &deep, &large, &large};
  for (int n = 0; n < 200; n++) {
    const int kind = n % 5;
    attack a;
    oracle_pose still = {{0, 0, 0}, {0, 0, 0, 1}};
    oracle_pose poses[3];
    const double turn = kind == 2 ? shapes_uniform(&rng, -0.2, 0.2) : shapes_uniform(&rng, -3, 3);
    const double from = shapes_uniform(&rng, 0.001, 0.1);
    const double to = shapes_uniform(&rng, 0.001, 0.1);
    for (int k = 0; k < 3; k++) {
      poses[k] = still;
      poses[k].position[0] = shapes_uniform(&rng, -0.05, 0.05) + (kind == 3 ? 0.5 : 0);
      poses[k].position[1] = shapes_uniform(&rng, -0.05, 0.05);
      poses[k].rotation[2] = sin(turn / 2 + 0.01 * k);
      poses[k].rotation[3] = cos(turn / 2 + 0.01 * k);
    }
    poses[0].position[2] = from;
    poses[1].position[2] = kind == 4 ? 1e-7 : -to;
    poses[2].position[2] = kind == 4 ? from : -to;
    a.moving = moving[kind];
    a.fixed = fixed[kind];
    proof_motion_set(&a.motion, poses, 3, &still);
    proof_ask(&a);
    const double when = 0.5 * from / (from + to);
    if (kind < 3) {
      CHECK_EQ(status_of(&a.answer), STATUS_WITNESS);
      CHECK_LE(fabs((double)a.answer.nearest.time - when), 1e-6);
      proof_check_witness(&a);
    }
    if (kind >= 3) CHECK_EQ(a.answer.verdict, NSVCD_FREE);
  }
  proof_free(&small);
  proof_free(&large);
  proof_free(&wide);
  proof_free(&deep);
}

// Every triangle twice, and some without area.
static void proof_triangles_listed_twice(void) {
  shapes_mesh shape;
  shapes_rng rng = {62};
  replay sum;
  within_sum within = {0, 0, 0, 0, 0, 0, 0};
  memset(&sum, 0, sizeof sum);
  proof_shape(BOX, 1, &shape);
  const size_t triangles = shape.triangles;
  for (size_t t = 0; t < triangles; t++) {
    const uint32_t *at = shape.indices + 3 * t;
    const uint32_t corners[3] = {at[0], at[1], at[2]};
    shapes_triangle(&shape, corners[0], corners[1], corners[2]);
    if (t % 8 == 0) shapes_triangle(&shape, corners[0], corners[1], corners[1]);
  }
  proof_body twice = proof_of_shape(&shape, 24);
  proof_body small = proof_make(BALL, 1, 12, 0.2);
  attack a;
  a.fixed = &twice;
  for (size_t trial = 0; trial < 200; trial++) {
    a.moving = trial % 2 ? &twice : &small;
    if (!proof_scene(&rng, &a, pow(10, shapes_uniform(&rng, -6, -1)), 1)) continue;
    proof_replay(&a, &rng, &sum);
    a.moving = &small;
    proof_place_within(&a, &rng, 0.01, 0, 0, &within);
  }
  proof_report("twice", &sum);
  CHECK_EQ(within.wrong, 0);
  CHECK_GE(within.inside, 10);
  proof_free(&twice);
  proof_free(&small);
}

// Samples half a turn apart: both arcs are the shorter one, to rounding, and all parts of the proof
// have to take the same.
static void proof_half_turns(void) {
  shapes_rng rng = {63};
  replay sum;
  memset(&sum, 0, sizeof sum);
  for (size_t trial = 0; trial < check_many(100); trial++) {
    attack a;
    oracle_pose fixed, pose, poses[PROOF_POSES];
    double point[3], away[3];
    const size_t count = 2 + (size_t)shapes_pick(&rng, 3);
    proof_any_two(&rng, &a);
    const double size = a.moving->size + a.fixed->size;
    shapes_quaternion(&rng, fixed.rotation);
    for (int k = 0; k < 3; k++) fixed.position[k] = 0;
    const double gap = size * pow(10, shapes_uniform(&rng, -3, 0));
    if (!proof_near_contact(&rng, &a, &fixed, gap, &pose, point, away)) continue;
    if (trial % 4 == 0) proof_random_rotation(&rng, 1, pose.rotation);
    proof_motion_past(&rng, &pose, point, away, size, SHAPES_PI * (double)(count - 1), count,
                      poses);
    for (size_t n = 0; n < count && trial % 4 == 0; n++) {  // dots of exactly 0, of either sign
      static const double turns[4][4] = {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}};
      memcpy(poses[n].rotation, turns[(n + trial / 4) % 4], sizeof turns[0]);
    }
    proof_motion_set(&a.motion, poses, count, &fixed);
    proof_replay(&a, &rng, &sum);
  }
  proof_report("half turns", &sum);
  CHECK_GE(sum.verdicts[STATUS_CERTIFIED_FREE], check_many(12));
}

// -------------------------------------------------------------------------------------------------
// tests

// 500 scenes of shared bodies, at gaps of 10^low to 10^high; gap and offset as at proof_scene, but
// no offset in each seventh.
static replay proof_scenes(const char *name, uint64_t seed, double low, double high,
                           double offset) {
  shapes_rng rng = {seed};
  replay sum;
  attack a;
  memset(&sum, 0, sizeof sum);
  for (size_t trial = 0; trial < check_many(120); trial++) {
    const double gap = pow(10, shapes_uniform(&rng, low, high));
    proof_any_two(&rng, &a);
    if (!proof_scene(&rng, &a, gap, trial % 7 ? offset : 0)) continue;
    proof_replay(&a, &rng, &sum);
  }
  proof_report(name, &sum);
  return sum;
}

static void proof_certificates_hold(void) {
  const replay sum = proof_scenes("near", 2024, -4, -1.3, 1);
  CHECK_GE(sum.verdicts[STATUS_CERTIFIED_FREE], check_many(25));
}

static void proof_certificates_hold_at_a_hair(void) {
  proof_scenes("hair", 77, -7.5, -4, 0.1);
}

// The mesh of another, multiplied: enough to place bodies by.
static proof_body proof_multiplied(const proof_body *from, float scale) {
  proof_body b;
  memset(&b, 0, sizeof b);
  b.vertices = from->vertices;
  b.triangles = from->triangles;
  b.size = from->size * (double)scale;
  b.positions = (double *)malloc(3 * b.vertices * sizeof(double));
  b.indices = (uint32_t *)malloc(3 * b.triangles * sizeof(uint32_t));
  if (!b.positions || !b.indices) exit(1);
  for (size_t i = 0; i < 3 * b.vertices; i++) b.positions[i] = from->positions[i] * (double)scale;
  memcpy(b.indices, from->indices, 3 * b.triangles * sizeof(uint32_t));
  if (!oracle_mesh_init(&b.oracle, b.positions, b.vertices, b.indices, b.triangles, 1)) exit(1);
  return b;
}

// One body at two sizes in one scene, alone or carried along.
static void proof_certificates_hold_for_scaled_bodies(void) {
  static const float scales[4] = {0.3f, 7.7f, 1.1e-5f, 13000.7f};
  shapes_rng rng = {98};
  replay sum;
  memset(&sum, 0, sizeof sum);
  for (size_t k = 0; k < check_many(8); k++) {
    const float scale = scales[k % 4];
    const float fixed_scale = scale * (float)pow(10, shapes_uniform(&rng, -1, 1));
    attack a, multiplied;
    proof_any_two(&rng, &a);
    proof_body moving = proof_multiplied(a.moving, scale);
    proof_body fixed = proof_multiplied(a.fixed, fixed_scale);
    multiplied.moving = &moving;
    multiplied.fixed = &fixed;
    for (size_t trial = 0; trial < 25; trial++) {
      const double gap = pow(10, shapes_uniform(&rng, -7, -2));
      attack one = a;
      if (!proof_scene(&rng, &multiplied, gap, trial % 3 ? 0.3 : 0)) continue;
      one.motion = multiplied.motion;
      one.motion.moving.scale = scale;
      one.motion.fixed.scale = fixed_scale;
      for (int i = 0; i < 3; i++) one.motion.moving.pivot[i] /= scale;  // as far in metres
      if (trial % 4 == 0)
        proof_carry(&rng, &one, shapes_uniform(&rng, 0, 6), moving.size + fixed.size);
      proof_replay(&one, &rng, &sum);
    }
    proof_free(&moving);
    proof_free(&fixed);
  }
  proof_report("scaled", &sum);
  CHECK_GE(sum.verdicts[STATUS_CERTIFIED_FREE], check_many(25));
}

// Near contact while both move: up to 720 degrees of spin, and poses of different counts.
static void proof_certificates_hold_where_both_move(void) {
  shapes_rng rng = {2025};
  replay sum;
  attack a;
  memset(&sum, 0, sizeof sum);
  memset(looked_at, 0, sizeof looked_at);
  for (size_t trial = 0; trial < check_many(120); trial++) {
    const double gap = pow(10, shapes_uniform(&rng, -6, -1.3));
    proof_any_two(&rng, &a);
    if (!proof_scene(&rng, &a, gap, trial % 7 ? 1 : 0)) continue;
    const double size = a.moving->size + a.fixed->size;
    const double angle = shapes_uniform(&rng, 0, 4 * SHAPES_PI);
    proof_carry_unevenly(&rng, &a, trial % 4 ? angle : 0, shapes_uniform(&rng, 0, 3) * size);
    proof_replay(&a, &rng, &sum);
  }
  proof_report("both move", &sum);
  proof_check_kinds();
  CHECK_GE(sum.verdicts[STATUS_CERTIFIED_FREE], check_many(25));
}

static void proof_certificates_hold_at_every_scale(void) {
  shapes_rng rng = {99};
  for (size_t scale = 1; scale < SCALES; scale++) {
    replay sum;
    attack a;
    char name[32];
    memset(&sum, 0, sizeof sum);
    for (size_t trial = 0; trial < check_many(20); trial++) {
      const double gap = pow(10, shapes_uniform(&rng, -6, -1.3));
      a.moving = proof_shared(scale, (size_t)shapes_pick(&rng, 8));
      a.fixed = proof_shared(scale, (size_t)shapes_pick(&rng, 8));
      if (!proof_scene(&rng, &a, gap, 1)) continue;
      proof_replay(&a, &rng, &sum);
    }
    snprintf(name, sizeof name, "scale %g", proof_scales[scale]);
    proof_report(name, &sum);
  }
}

// A tip that swings over a box, about a pivot above it, and dips into it only while it is under the
// pivot: at the ends of the swing it is clear of the box. depth: of the tip's radius; negative: it
// stays above.
static status proof_swing(double scale, double angle, double depth, size_t count) {
  static const double down[3][3] = {{0, 0, -0.25}, {0.02, 0, 0.2}, {-0.02, 0.02, 0.2}};
  const nsvcd_encode_options options = {.patches = 1, .open = 1};
  const double axis[3] = {0, 1, 0};
  const double still[4] = {0, 0, 0, 1};
  shapes_mesh shape;
  oracle_pose poses[PROOF_POSES], fixed;
  attack a;
  memset(&shape, 0, sizeof shape);
  for (int k = 0; k < 3; k++) shapes_vertex(&shape, down[k][0], down[k][1], down[k][2]);
  shapes_triangle(&shape, 0, 1, 2);
  proof_body tip = proof_encode(&shape, scale, &options);
  proof_body box = proof_make(BOX, 6, 32, scale);
  memset(&fixed, 0, sizeof fixed);
  memcpy(fixed.rotation, still, sizeof still);
  for (size_t n = 0; n < count; n++) {
    const double fraction = count > 1 ? (double)n / (double)(count - 1) - 0.5 : 0;
    poses[n] = fixed;
    oracle_axis_angle(axis, angle * fraction, poses[n].rotation);
    poses[n].position[0] = 0.013 * scale;
    poses[n].position[1] = 0.007 * scale;
    poses[n].position[2] = (0.05 + 0.25 * (1 - depth)) * scale;
  }
  a.moving = &tip;
  a.fixed = &box;
  proof_motion_set(&a.motion, poses, count, &fixed);
  proof_ask(&a);
  shapes_rng rng = {5};
  replay sum;
  memset(&sum, 0, sizeof sum);
  proof_replay_records(&a, &rng, &sum);
  CHECK_EQ(sum.wrong, 0);
  proof_free(&tip);
  proof_free(&box);
  return status_of(&a.answer);
}

static void proof_sees_a_swing(void) {
  for (size_t scale = 0; scale < SCALES; scale++) {
    for (int trial = (int)scale % 2; trial < 12; trial += 2) {
      const double angle = 0.125 * (1 + trial / 3);
      const double sagitta = 1 - cos(angle / 2);
      const double depth = sagitta * (0.2 + 0.3 * (trial % 3));
      const status said = proof_swing(proof_scales[scale], angle, depth, 2);
      if (said == STATUS_CERTIFIED_FREE)
        printf("  scale %g angle %g: free\n", proof_scales[scale], angle);
      CHECK(said != STATUS_CERTIFIED_FREE);
      CHECK_EQ(proof_swing(proof_scales[scale], angle, -0.01, 2), STATUS_CERTIFIED_FREE);
    }
  }
}

void test_proof(void) {
  RUN(proof_sees_a_swing);
  RUN(proof_certificates_hold);
  RUN(proof_certificates_hold_at_a_hair);
  RUN(proof_certificates_hold_at_every_scale);
  RUN(proof_certificates_hold_for_scaled_bodies);
  RUN(proof_certificates_hold_where_both_move);
  RUN(proof_crossings_are_never_free);
  RUN(proof_crossings_of_coarse_bodies_are_never_free);
  RUN(proof_spans_hold_the_motion);
  RUN(proof_spans_hold_along_directions);
  RUN(proof_arcs_hold_along_directions);
  RUN(proof_finds_first_contacts);
  RUN(proof_keeps_clearances);
  RUN(proof_may_forget);
  RUN(proof_leaves_contacts);
  RUN(proof_points_are_of_the_lifted);
  RUN(proof_push_outs_are_true);
  RUN(proof_knows_what_is_within);
  RUN(proof_says_where_inside);
  RUN(proof_rays_miss_nothing);
  RUN(proof_sides_do_not_matter);
  RUN(proof_keeps_its_limit);
  RUN(proof_keeps_its_limit_in_large_patches);
  RUN(proof_in_doubt_ends_soon);
  RUN(proof_turning_on_a_coarse_floor_is_never_free);
  RUN(proof_takes_no_more_work);
  RUN(proof_higher_limits_take_no_more_work);
  RUN(proof_tells_more_with_more_work);
  RUN(proof_bodies_on_themselves);
  RUN(proof_faces_pass);
  RUN(proof_triangles_listed_twice);
  RUN(proof_half_turns);
  printf(
      "  %zu points of manifolds; %zu witnesses, gap at most %.3g of what is allowed; normals "
      "along "
      "the motion: %zu; none: %zu\n",
      witnesses.supports, witnesses.count, witnesses.worst_gap, witnesses.leaving,
      witnesses.no_normal);
}

CHECK_ALONE(test_proof)
