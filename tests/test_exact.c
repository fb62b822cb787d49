// Verdicts at the edge, held against exact arithmetic: two triangles, or bodies of two, that touch,
// or miss or cross each other by a float's last digit or by as little as 1e-12 of their size; of any
// size, far from each other in size, flat, thin, without area, round, scaled, turned by rotations
// that floats have exactly; at rest, or moved straight. `make check-exact` asks 50,000 of them.
#undef NSVCD_NO_DISPATCH
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_certify.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/scenery/oracle.h"
#include "check.h"
#include "exact.h"
#include "random_numbers.h"

void test_exact(void);

// -------------------------------------------------------------------------------------------------
// what is asked

enum { CORNER, EDGE, FACE };
static const char *const feature_names[] = {"corner", "edge", "face"};

// One side of a scene.
typedef struct edge_body {
  float corners[6][3];  // of its mesh
  int triangles;
  float scale, round;
  nsvcd_pose poses[2];
  exact_body exact;
  const nsvcd_body *body;
} edge_body;

typedef struct edge_scene {
  edge_body sides[2];  // a and b
  int features[2], moves;
  float clearance;
  double lengths, way;      // all that enters, the motion's
  double limits[3], limit;  // what they may come within: round, round and clearance; their sum
  exact_distance near;      // in all of the motion
} edge_scene;

// Whole numbers as vectors.
static void lattice(double reach, double *out) {
  do {
    for (int k = 0; k < 3; k++) out[k] = floor(uniform(-reach, reach + 1));
  } while (!(oracle_dot(out, out) > 0));
}
static void along(const double *x, double by, double *out) {
  for (int k = 0; k < 3; k++) out[k] += by * x[k];
}

// A plane that both bodies are on their sides of, and directions in it; whole numbers.
typedef struct edge_plane {
  double u, v, thin;  // multiples of these at most
  double in[2][3], out[3], normal[3];
} edge_plane;

static edge_plane edge_plane_of(void) {
  edge_plane p;
  const double reach = pick(0, 2) ? 4 : 512;
  p.u = pick(0, 1) ? 8 : 1024;
  p.v = pick(0, 4) ? p.u : 1;
  if (p.v < 2) p.u = pick(0, 1) ? 1e3 : 1e5;  // slivers
  const int is_plain = pick(0, 2) == 0;       // along the axes
  do {
    lattice(reach, p.in[0]);
    lattice(reach, p.in[1]);
    lattice(reach, p.out);
    for (int k = 0; k < 3 && is_plain; k++) {
      p.in[0][k] = k == 0;
      p.in[1][k] = k == 1;
    }
    oracle_cross(p.in[0], p.in[1], p.normal);
  } while (!(fabs(oracle_dot(p.normal, p.out)) > 0));
  if (oracle_dot(p.normal, p.out) < 0)
    for (int k = 0; k < 3; k++) p.out[k] = -p.out[k];
  return p;
}
static double some(double most) {
  return (double)pick(1, (size_t)most);
}

// Corners that have a feature about the origin in the plane, and else are on one side of it.
static void edge_corners(const edge_plane *p, int feature, int side, double (*out)[3]) {
  const double *e[2] = {p->in[side < 0 ? 0 : 1], p->in[side < 0 ? 1 : 0]};
  const double most[2] = {side < 0 ? p->u : p->v, side < 0 ? p->v : p->u};
  memset(out, 0, 9 * sizeof(double));
  // coplanar, at times
  const double up[2] = {pick(0, 3) ? side * some(8) : 0, pick(0, 3) ? side * some(8) : 0};
  if (feature == FACE) {
    along(e[0], some(most[0]), out[0]);
    along(e[1], some(most[1]), out[1]);
    along(e[0], -some(most[0]), out[2]);
    along(e[1], -some(most[1]), out[2]);
  } else if (feature == EDGE) {
    along(e[0], some(most[0]), out[0]);
    along(e[0], -some(most[0]), out[1]);
    along(e[1], side * some(most[1]), out[2]);
    along(p->out, up[0], out[2]);
  } else {
    for (int k = 1; k < 3; k++) {
      along(e[0], some(most[0]) * (pick(0, 1) ? 1 : -1), out[k]);
      along(e[1], side * some(most[1]), out[k]);
      along(p->out, up[k - 1], out[k]);
    }
  }
  if (pick(0, 9) == 0) memcpy(out[pick(0, 1)], out[2], sizeof out[2]);  // a segment, or a point
  if (pick(0, 59) == 0) memcpy(out[0], out[1], sizeof out[1]);
}

// The rotations of a tetrahedron: their quaternions are floats of length 1.
static void edge_rotation(float *q) {
  const float half = 0.5f;
  const size_t kind = pick(0, 11);
  for (int k = 0; k < 4; k++) q[k] = kind < 4 ? (k == (int)kind) : half;
  for (int k = 0; k < 3 && kind >= 4; k++)
    if ((kind - 4) >> k & 1) q[k] = -half;
}

// As the library has it: what is scaled and turned exactly; doubles hold it.
static void edge_finish(edge_body *b) {
  double q[4], m[9];
  for (int k = 0; k < 4; k++) q[k] = (double)b->poses[0].rotation[k];
  oracle_matrix(q, m);
  for (int i = 0; i < 3 * b->triangles; i++) {
    double x[3];
    for (int k = 0; k < 3; k++) x[k] = (double)b->scale * (double)b->corners[i][k];
    oracle_rotate(m, x, b->exact.corners[i]);
  }
  b->exact.triangles = b->triangles;
  for (int i = 0; i < 6; i++)
    b->exact.poses[i / 3][i % 3] = (double)b->poses[i / 3].position[i % 3];
}

static double edge_reach(const edge_body *b) {
  double reach = 0;
  for (int i = 0; i < 3 * b->triangles; i++)
    reach = fmax(reach, oracle_length(b->exact.corners[i]));
  return reach + (double)b->scale * (double)b->round;
}

// Corners in the world, about where they touch, become a body: turned back, scaled down, and
// about an origin `offset` away. A triangle without area is one of two: the other is far out.
static void edge_body_of(double (*world)[3], int side, double size, const double *offset,
                         edge_body *out) {
  double q[4], m[9];
  const double u[3] = {world[1][0] - world[0][0], world[1][1] - world[0][1],
                       world[1][2] - world[0][2]};
  const double v[3] = {world[2][0] - world[0][0], world[2][1] - world[0][1],
                       world[2][2] - world[0][2]};
  double normal[3];
  oracle_cross(u, v, normal);
  for (int k = 0; k < 4; k++) q[k] = (double)out->poses[0].rotation[k];
  oracle_matrix(q, m);
  out->triangles = oracle_dot(normal, normal) > 0 || out->round > 0 ? 1 : 2;
  for (int i = 0; i < 3 * out->triangles; i++) {
    double x[3], back[3];
    for (int k = 0; k < 3; k++) x[k] = (world[i % 3][k] + offset[k]) * size;
    for (int k = 0; k < 3 && i >= 3; k++) x[k] = side * 2e3 * size * (double)(1 + (k == i - 3));
    oracle_rotate_back(m, x, back);
    for (int k = 0; k < 3; k++) out->corners[i][k] = (float)(back[k] / (double)out->scale);
  }
}

// Where a is at the ends of its motion about b, before the least of gaps.
static void edge_motion(const edge_plane *p, int moves, double (*ends)[3]) {
  const double by = some(8);
  memset(ends, 0, 6 * sizeof(double));
  if (moves == 1 || moves == 3) along(p->out, by, ends[0]);  // comes to the contact; passes through
  if (moves == 2) along(p->out, by, ends[1]);                // leaves it
  if (moves == 3) along(p->out, -by, ends[1]);
  if (moves == 4) {  // goes along the plane
    along(p->in[0], -by, ends[0]);
    along(p->in[0], by, ends[1]);
  }
  if (moves == 1 && pick(0, 1)) along(p->in[1], by, ends[0]);
}

static int edge_encode(edge_body *b) {
  uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
  nsvcd_encode_options options;
  const nsvcd_mesh mesh = {b->corners[0], indices, 3 * (size_t)b->triangles, (size_t)b->triangles};
  memset(&options, 0, sizeof options);
  options.convex_radius = b->round;
  return nsvcd_encode(&mesh, &options, NULL, NULL, 0, &b->body) == NSVCD_OK;
}

// A scene at the edge. 0: a body that cannot be, as what is too small.
static int edge_make(edge_scene *s) {
  const edge_plane p = edge_plane_of();
  double corners[3][3], offsets[2][3], drift[3], ends[2][3];
  double sizes[2];
  const int is_round = pick(0, 7) == 0;
  const int is_off = pick(0, 2) == 0;
  memset(s, 0, sizeof *s);
  sizes[0] = sizes[1] = ldexp(1, (int)pick(0, 12) - 10);
  if (pick(0, 2) == 0)
    for (int k = 0; k < 2; k++) sizes[k] = ldexp(1, (int)pick(0, 20) - (p.u > 1e4 ? 20 : 12));
  s->moves = (int)pick(0, 4);
  s->clearance = pick(0, 5) ? 0 : (float)(uniform(0.01, 2) * sizes[0]);
  float turn[4];
  edge_rotation(turn);
  for (int n = 0; n < 2; n++) {
    edge_body *b = &s->sides[n];
    s->features[n] = (int)pick(0, 2);
    edge_corners(&p, s->features[n], n ? -1 : 1, corners);
    b->scale = pick(0, 4) ? 1 : (float)uniform(0.1, 3);
    b->round = is_round ? (float)(uniform(0.01, 2) * sizes[n]) : 0;
    for (int k = 0; k < 2; k++) memcpy(b->poses[k].rotation, turn, sizeof turn);
    lattice(8, offsets[n]);
    for (int k = 0; k < 3; k++) offsets[n][k] *= is_off;
    edge_body_of(corners, n ? -1 : 1, sizes[n], offsets[n], b);
    if (pick(0, 1)) edge_rotation(turn);  // b is turned otherwise
  }
  // the gap: that of what is round or to be kept clear of, and a little
  const double large = fmax(sizes[0], sizes[1]);
  double gap = (double)s->clearance;
  for (int n = 0; n < 2; n++) gap += (double)s->sides[n].round * (double)s->sides[n].scale;
  const int how = (int)pick(0, 9);
  if (how > 2) gap += large * pow(10, -(double)pick(6, 12)) * (pick(0, 1) ? 1 : -1);
  if (how == 2) gap *= 1 + (pick(0, 1) ? 1.2e-7 : -1.2e-7);
  edge_motion(&p, s->moves, ends);
  lattice(8, drift);
  for (int i = 0; i < 6; i++) {
    const int n = i / 3;
    const int k = i % 3;
    const double moved = is_off ? n * drift[k] * sizes[1] : 0;  // both move
    const double lifted = p.normal[k] * gap / oracle_length(p.normal);
    const double aside = offsets[1][k] * sizes[1] - offsets[0][k] * sizes[0];
    s->sides[0].poses[n].position[k] = (float)(ends[n][k] * large + aside + moved + lifted);
    s->sides[1].poses[n].position[k] = (float)moved;
    if (fabs(ends[n][k] * large + aside) + fabs(moved) > 1e5) return 0;
  }
  for (int n = 0; n < 2; n++) {
    edge_finish(&s->sides[n]);
    if (!edge_encode(&s->sides[n])) return 0;
    s->limits[n] = (double)s->sides[n].round * (double)s->sides[n].scale;
    s->lengths += edge_reach(&s->sides[n]);
  }
  if (s->lengths > 2e5) return 0;
  s->limits[2] = (double)s->clearance;
  double away[2][3], way[3];
  for (int n = 0; n < 2; n++)
    oracle_sub(s->sides[0].exact.poses[n], s->sides[1].exact.poses[n], away[n]);
  oracle_sub(away[1], away[0], way);
  s->limit = s->limits[0] + s->limits[1] + s->limits[2];
  s->way = s->moves ? oracle_length(way) : 0;
  s->lengths += fmax(oracle_length(away[0]), s->moves ? oracle_length(away[1]) : 0) + s->limits[2];
  s->near = exact_between(&s->sides[0].exact, &s->sides[1].exact, 0, s->moves ? EXACT_TICKS : 0);
  return 1;
}

// -------------------------------------------------------------------------------------------------
// what is said of it

typedef struct edge_tally {
  size_t asked, near, verdicts[3], wrong;
  double open,
      apart;  // of the lengths: how far from the edge is undecided, is a HIT of what is apart
} edge_tally;

#define SAME 1e-12   // of the lengths: a HIT may be of what is that near
#define CLOSE 1e-9   // of the lengths: what is that near may be left undecided
#define FLOATS 4e-6  // of a number: how an answer is rounded

static nsvcd_answer edge_ask_within(const edge_scene *s, nsvcd_ask ask, double to, size_t work) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(16, 16, 64));
  nsvcd_question q;
  nsvcd_answer answer;
  nsvcd_mover *movers[2] = {&q.a, &q.b};
  memset(&q, 0, sizeof q);
  memset(&answer, 0, sizeof answer);
  for (int n = 0; n < 2; n++) {
    movers[n]->body = s->sides[n].body;
    movers[n]->poses = s->sides[n].poses;
    movers[n]->count = s->moves ? 2 : 1;
    movers[n]->scale = s->sides[n].scale;
  }
  q.ask = ask;
  q.to = (float)to;
  q.work = work;
  q.clearance = s->clearance;
  CHECK_EQ(nsvcd_sweep(&q, workspace, sizeof workspace, &answer), NSVCD_OK);
  return answer;
}

static nsvcd_answer edge_ask(const edge_scene *s, nsvcd_ask ask, double to) {
  return edge_ask_within(s, ask, to, 0);
}

// What is false of a verdict, or left open without need; NULL: nothing.
static const char *edge_fault(const edge_scene *s, const nsvcd_answer *answer) {
  const double gap = s->near.metres - s->limit;
  switch (answer->verdict) {
    case NSVCD_HIT:
      return gap > SAME * s->lengths ? "a HIT of what is apart" : NULL;
    case NSVCD_FREE:
      return exact_compare(&s->near, s->limits, 3) <= 0 ? "FREE, and they meet" : NULL;
    default:
      if (answer->why != NSVCD_WHY_TOO_NEAR) return "UNDECIDED, for its work";
      return fabs(gap) > CLOSE * s->lengths ? "UNDECIDED" : NULL;
  }
}

// Of DISTANCE: the bracket holds it.
static const char *edge_distance_fault(const edge_scene *s, const nsvcd_answer *answer, double to) {
  const double distance = fmax(s->near.metres - s->limits[0] - s->limits[1], 0);
  const double epsilon = 10 * SAME * s->lengths;
  const double low = (double)answer->distance.low;
  const double high = (double)answer->distance.high;
  if (answer->verdict == NSVCD_HIT)
    return high > (double)s->clearance * (1 + FLOATS) + epsilon ? "distance.high of a HIT" : NULL;
  if (low > distance + epsilon) return "distance.low";
  if (high < distance - epsilon) return "distance.high";
  return high - low > to + FLOATS * high + CLOSE * s->lengths ? "a wide bracket" : NULL;
}

// Of FIRST: before time.low they are free of each other, and at time.high, which is rounded up, they
// are as near as was asked for.
static const char *edge_first_fault(const edge_scene *s, const nsvcd_answer *answer, double to) {
  const exact_body *a = &s->sides[0].exact;
  const exact_body *b = &s->sides[1].exact;
  const double before = floor(EXACT_TICKS * (double)answer->time.low) - 2;
  const double high = fmin(ceil(EXACT_TICKS * (double)answer->time.high), EXACT_TICKS);
  if (before > 0) {
    const exact_distance near = exact_between(a, b, 0, before);
    if (exact_compare(&near, s->limits, 3) <= 0) return "met before time.low";
  }
  if (answer->verdict != NSVCD_HIT) return NULL;
  const exact_distance then = exact_between(a, b, fmax(floor(high * (1 - FLOATS)), 0), high);
  const double went = s->way * (double)(answer->time.high - answer->time.low);
  if (then.metres > s->limit + to + SAME * s->lengths) return "apart at time.high";
  if (went <= to + (CLOSE + FLOATS) * s->lengths) return NULL;
  // time.low is a float that is rounded down
  const exact_distance early = exact_between(a, b, fmax(before, 0), fmax(before, 0) + 600);
  const int is_close = early.metres <= s->limit + CLOSE * s->lengths;
  return answer->why == NSVCD_WHY_TOO_NEAR && is_close ? NULL : "time.low is early";
}

static void edge_tell(const edge_scene *s, const char *fault, const nsvcd_answer *answer) {
  printf("%s: %s on %s, moves %d, scales %g %g; %.9g m apart, less %.9g; lengths %.3g\n", fault,
         feature_names[s->features[0]], feature_names[s->features[1]], s->moves,
         (double)s->sides[0].scale, (double)s->sides[1].scale, s->near.metres, s->limit,
         s->lengths);
  printf("  %s, why %d, time %.9g to %.9g, distance %.9g to %.9g\n",
         nsvcd_verdict_string(answer->verdict), (int)answer->why, (double)answer->time.low,
         (double)answer->time.high, (double)answer->distance.low, (double)answer->distance.high);
}

static void edge_judge(const edge_scene *s, edge_tally *sum) {
  const double to = (double)(float)(1e-5 * s->lengths);
  const int asks_first = s->moves && pick(0, 1);
  const double gap = (s->near.metres - s->limit) / s->lengths;
  nsvcd_answer answer = edge_ask(s, NSVCD_ASK_HIT, 0);
  const char *fault = edge_fault(s, &answer);
  sum->asked++;
  sum->near += fabs(gap) <= CLOSE;
  sum->verdicts[answer.verdict]++;
  if (answer.verdict == NSVCD_UNDECIDED) sum->open = fmax(sum->open, fabs(gap));
  if (answer.verdict == NSVCD_HIT) sum->apart = fmax(sum->apart, gap);
  if (!fault) {
    answer = edge_ask(s, asks_first ? NSVCD_ASK_FIRST : NSVCD_ASK_DISTANCE, to);
    fault = edge_fault(s, &answer);
    if (!fault)
      fault = asks_first ? edge_first_fault(s, &answer, to) : edge_distance_fault(s, &answer, to);
  }
  if (fault && sum->wrong++ < 20) edge_tell(s, fault, &answer);
}

static void exact_verdicts_at_the_edge(void) {
  edge_tally sum;
  memset(&sum, 0, sizeof sum);
  rng_state = 46;
  while (sum.asked < check_many(1000)) {
    edge_scene s;
    if (edge_make(&s)) edge_judge(&s, &sum);
    for (int n = 0; n < 2; n++) nsvcd_body_free(s.sides[n].body, NULL);
  }
  printf("%zu pairs, %zu of them within 1e-9 of the edge: ", sum.asked, sum.near);
  printf("%zu free, %zu hit, %zu undecided; %zu wrong; of the lengths ", sum.verdicts[NSVCD_FREE],
         sum.verdicts[NSVCD_HIT], sum.verdicts[NSVCD_UNDECIDED], sum.wrong);
  printf("undecided until %.2g, hits apart by %.2g\n", sum.open, sum.apart);
  CHECK_EQ(sum.wrong, 0);
  // doubles would tell more: planes are aimed as well as that
  CHECK_LE(sum.open, 2e-11);
}

// Two parts slide side by side on a base that is far away; joints are doubles.
static void exact_configurations_far_away(void) {
  const float far[5] = {0, 3, 100, 1e4f, 5e5f};
  const float half[3] = {0.125f, 0.125f, 0.125f};
  const nsvcd_body *box = NULL;
  size_t free_ones = 0;
  size_t wrong = 0;
  CHECK_EQ(nsvcd_encode_box(half, 0, NULL, &box), NSVCD_OK);
  for (size_t i = 0; i < 500; i++) {
    const double lengths = 1 + (double)far[i % 5];
    const double gap = fmin(lengths * pow(10, -(double)pick(6, 11)), 0.1) * (i / 5 % 2 ? 1 : -1);
    const double start = 0.1 + 0.00137 * (double)i;
    const double q[2] = {start, start + 0.25 + gap};
    const double truth = q[1] - q[0] - 0.25;
    const nsvcd_joint_motion still = {0, 1, q, NULL};
    const nsvcd_body_pair pair = {0, 1};
    nsvcd_joint joints[2];
    nsvcd_part parts[2];
    nsvcd_check_answer answer;
    nsvcd_checker *checker = NULL;
    memset(&answer, 0, sizeof answer);
    memset(joints, 0, sizeof joints);
    memset(parts, 0, sizeof parts);
    for (uint32_t n = 0; n < 2; n++) {
      joints[n].kind = NSVCD_JOINT_PRISMATIC;
      joints[n].axis[0] = 1;
      joints[n].origin.rotation[3] = 1;
      joints[n].origin.position[0] = far[i % 5];
      joints[n].low = -2;
      joints[n].high = 2;
      parts[n].body = box;
      parts[n].link = 1 + n;
      parts[n].pose.rotation[3] = 1;
    }
    const nsvcd_scene scene = {joints, 2, parts, 2, &pair, 1, NULL, NULL, 0, NULL, 0};
    void *memory = malloc(nsvcd_checker_size(&scene));
    CHECK_EQ(nsvcd_checker_open(&scene, memory, nsvcd_checker_size(&scene), &checker), NSVCD_OK);
    CHECK_EQ(nsvcd_check(checker, &still, NULL, &answer), NSVCD_OK);
    free_ones += answer.verdict == NSVCD_FREE;
    wrong += answer.verdict == NSVCD_FREE && truth <= 0;
    wrong += answer.verdict == NSVCD_HIT && truth > SAME * lengths + 1e-7;  // poses in float
    free(memory);
  }
  CHECK_EQ(wrong, 0);
  CHECK_GE(free_ones, 50);
  nsvcd_body_free(box, NULL);
}

// The oracle itself: at one time against one in double, and over a motion against many times.
static void exact_distances_are_right(void) {
  size_t apart = 0;
  for (size_t i = 0; i < check_many(20); i++) {
    exact_body bodies[2];
    memset(bodies, 0, sizeof bodies);
    for (int n = 0; n < 2; n++) {
      bodies[n].triangles = 1;
      for (int k = 0; k < 9; k++) bodies[n].corners[k / 3][k % 3] = uniform(-1, 1);
      for (int k = 0; k < 6; k++) bodies[n].poses[k / 3][k % 3] = uniform(-2, 2) + 100;
    }
    const double all = exact_between(&bodies[0], &bodies[1], 0, EXACT_TICKS).metres;
    double least = 1e9;
    for (int step = 0; step <= 64; step++) {
      const double tick = EXACT_TICKS * step / 64;
      const exact_distance here = exact_between(&bodies[0], &bodies[1], tick, tick);
      oracle_triangle triangles[2];
      double on[2][3];
      for (int k = 0; k < 18; k++) {
        const exact_body *b = &bodies[k / 9];
        const double moved = b->poses[1][k % 3] - b->poses[0][k % 3];
        triangles[k / 9].v[k % 9 / 3][k % 3] =
            b->corners[k % 9 / 3][k % 3] + b->poses[0][k % 3] + moved * step / 64;
      }
      for (int n = 0; n < 2; n++) oracle_triangle_normal(&triangles[n]);
      const double square = oracle_triangles(&triangles[0], &triangles[1], 1e9, on[0], on[1]);
      CHECK_NEAR(here.metres, sqrt(square), 1e-7);
      CHECK_NEAR(here.metres * here.metres, square, 1e-12);
      const double more = here.metres * (1 + 1e-15);
      CHECK(!(here.metres > 0) || exact_compare(&here, &more, 1) < 0);
      least = fmin(least, here.metres);
    }
    CHECK_LE(all, least * (1 + 1e-15));
    CHECK_GE(all, least - 14.0 / 128);  // half a step of the fastest motion
    apart += all > 0;
  }
  CHECK_GE(apart, 1);
}

// Floats that are equal or denormal, and no area: refused by name, unless something is left.
static void exact_refuses_what_is_nothing(void) {
  uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
  static float positions[4][18] = {
      {1, 2, 3, 1, 2, 3, 1, 2, 3},                                   // a point
      {0, 0, 0, 1e-40f, 0, 0, 0, 1e-40f, 0},                         // denormal
      {0, 0, 0, 1, 1, 1, 2, 2, 2},                                   // a segment
      {0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, 1e-40f, 0, 1, 0, 1, 0}};  // and a triangle
  for (int n = 0; n < 4; n++) {
    const nsvcd_mesh mesh = {positions[n], indices, n == 3 ? 6 : 3, n == 3 ? 2 : 1};
    const nsvcd_body *body = NULL;
    const nsvcd_result result = nsvcd_encode(&mesh, NULL, NULL, NULL, 0, &body);
    CHECK_EQ(result, n == 3 ? NSVCD_OK : NSVCD_ERROR_EMPTY);
    nsvcd_body_free(body, NULL);
  }
}

// However little work is allowed, what is said is true.
static void exact_verdicts_of_little_work(void) {
  rng_state = 47;
  for (size_t i = 0; i < check_many(300); i++) {
    edge_scene s;
    if (edge_make(&s)) {
      const nsvcd_answer answer = edge_ask_within(&s, NSVCD_ASK_HIT, 0, 1 + i % 4);
      const char *fault = answer.verdict == NSVCD_UNDECIDED ? NULL : edge_fault(&s, &answer);
      if (fault) edge_tell(&s, fault, &answer);
      CHECK(!fault);
    }
    for (int n = 0; n < 2; n++) nsvcd_body_free(s.sides[n].body, NULL);
  }
}

void test_exact(void) {
  RUN(exact_refuses_what_is_nothing);
  RUN(exact_verdicts_of_little_work);
  RUN(exact_distances_are_right);
  RUN(exact_verdicts_at_the_edge);
  RUN(exact_configurations_far_away);
}

CHECK_ALONE(test_exact)
