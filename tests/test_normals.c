// Which way a contact's normal points: against the motion of its point, as poses in double have it,
// wherever a motion leads to a contact.
#define NSVCD_STATIC
#define NSVCD_NO_NETWORK
#include "../src/ground/strings.h"
#include "../src/body/trust.h"
#include "../src/body/shapes.h"
#include "../src/query/question.h"

#include "body_of.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "question_of.h"
#include "check.h"

void test_normals(void);

// A body and its mesh. Of round ones that are no mesh there are no triangles.
typedef struct normals_body {
  const nsvcd_body *body;
  shapes_mesh mesh;
  int closed;
} normals_body;

static normals_body normals_encode(shapes_mesh *mesh, int closed, int open, double round) {
  const nsvcd_encode_options options = {.open = open, .convex_radius = (float)round};
  const normals_body out = {body_of(mesh, &options), *mesh, closed};
  return out;
}

static void normals_free(normals_body *b) {
  nsvcd_body_free(b->body, NULL);
  shapes_free(&b->mesh);
}

enum { BOX, CUT_BOX, CONE, TORUS, MUG, ROUND_BOX, SHEET, SOUP, ROUND_SOUP, SPHERE, CAPSULE, KINDS };

static normals_body normals_make(shapes_rng *rng, int kind) {
  const float ends[2][3] = {{0, 0, -0.1f}, {0, 0, 0.1f}};
  normals_body out;
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  memset(&out, 0, sizeof out);
  const int open = shapes_pick(rng, 2);
  const double size = shapes_uniform(rng, 0.1, 0.3);
  if (kind == SPHERE) CHECK_EQ(nsvcd_encode_sphere((float)size, NULL, &out.body), NSVCD_OK);
  if (kind == CAPSULE)
    CHECK_EQ(nsvcd_encode_capsule(ends[0], ends[1], 0.05f, NULL, &out.body), NSVCD_OK);
  if (kind == SPHERE || kind == CAPSULE) return out;
  if (kind == BOX || kind == CUT_BOX || kind == ROUND_BOX)
    shapes_box(&mesh, size, 0.2, 0.3, kind == CUT_BOX ? 5 : 1);
  if (kind == CONE) shapes_cone(&mesh, size, 0, 0.3, 5);
  if (kind == TORUS) shapes_torus(&mesh, 0.15, 0.05, 12, 8);
  if (kind == MUG) shapes_mug(&mesh, 0.1, 0.2, 0.01, 10);
  if (kind == SHEET) {
    for (int k = 0; k < 4; k++) shapes_vertex(&mesh, k & 1 ? size : -size, k & 2 ? 0.2 : -0.2, 0);
    shapes_quad(&mesh, 0, 1, 3, 2);
  }
  const int triangles = kind == SOUP || kind == ROUND_SOUP ? 1 + shapes_pick(rng, 3) : 0;
  for (int n = 0; n < triangles; n++) {
    double v[9];
    for (int k = 0; k < 9; k++) v[k] = shapes_uniform(rng, -0.2, 0.2);
    const uint32_t a = shapes_vertex(&mesh, v[0], v[1], v[2]);
    const uint32_t b = shapes_vertex(&mesh, v[3], v[4], v[5]);
    shapes_triangle(&mesh, a, b, shapes_vertex(&mesh, v[6], v[7], v[8]));
  }
  const double round = kind == ROUND_BOX || kind == ROUND_SOUP ? 0.02 : 0;
  return normals_encode(&mesh, kind < SHEET, kind >= SHEET && open, round);
}

static nsvcd_answer normals_ask(const nsvcd_question *question) {
  static NSVCD_MEMORY(workspace, NSVCD_PROOF_WORKSPACE_BYTES(512, 512, 64));
  nsvcd_answer answer;
  memset(&answer, 0, sizeof answer);
  CHECK_EQ(nsvcd_sweep(question, workspace, sizeof workspace, &answer), NSVCD_OK);
  return answer;
}

// ------------------------------------------------------------------------------------------ speeds

// Where a mover is at a time, in double, its poses uniform in time.
static oracle_pose normals_pose(const nsvcd_mover *mover, double t) {
  oracle_pose poses[4];
  for (size_t k = 0; k < mover->count; k++) poses[k] = pose_widened(&mover->poses[k]);
  return oracle_pose_at(poses, mover->count, t);
}

// The velocity of the point of the body that is at x at a time: by where it is a little before and
// after, within the way between two poses; at a pose by that before.
static void normals_speed(const nsvcd_mover *mover, double t, const double *x, double *speed) {
  const double arcs = mover->count > 1 ? (double)(mover->count - 1) : 1;
  const double first = fmax(ceil(t * arcs - 1e-6) - 1, 0) / arcs;
  const double from = fmax(t - 1e-5, first);
  const double to = fmin(t + 1e-5, first + 1 / arcs);
  const oracle_pose now = normals_pose(mover, t);
  const oracle_pose ends[2] = {normals_pose(mover, from), normals_pose(mover, to)};
  double m[9], off[3], own[3], places[2][3];
  oracle_matrix(now.rotation, m);
  oracle_sub(x, now.position, off);
  oracle_rotate_back(m, off, own);
  for (int n = 0; n < 2; n++) oracle_transform(&ends[n], own, places[n]);
  for (int k = 0; k < 3; k++) speed[k] = (places[1][k] - places[0][k]) / (to - from);
}

// A triangle of a body at a time. Returns 0 if there is none.
static int normals_triangle(const normals_body *b, const nsvcd_mover *mover, double t,
                            uint32_t number, oracle_triangle *out) {
  const oracle_pose pose = normals_pose(mover, t);
  memset(out, 0, sizeof *out);
  if (number >= b->mesh.triangles) return 0;
  for (int k = 0; k < 3; k++) {
    const size_t corner = b->mesh.indices[3 * number + (size_t)k];
    oracle_transform(&pose, &b->mesh.positions[3 * corner], out->v[k]);
  }
  oracle_triangle_normal(out);
  return 1;
}

typedef struct normals_scene {
  normals_body bodies[2];
  nsvcd_pose poses[2][3];
  nsvcd_question question;
  size_t contacts, leaving;
} normals_scene;

// The velocity of a's point of a contact, as b's has it, along the normal and in all.
static double normals_along(const normals_scene *s, const nsvcd_contact *c, double *speed) {
  const double x[3] = {(double)c->point[0], (double)c->point[1], (double)c->point[2]};
  const double n[3] = {(double)c->normal[0], (double)c->normal[1], (double)c->normal[2]};
  double of_b[3];
  normals_speed(&s->question.a, (double)c->time, x, speed);
  normals_speed(&s->question.b, (double)c->time, x, of_b);
  for (int k = 0; k < 3; k++) speed[k] -= of_b[k];
  CHECK_NEAR(oracle_length(n), 1, 1e-5);
  return oracle_dot(speed, n);
}

// Does a point leave both faces of a contact? Those of an open surface look where its normal does.
static int normals_forbidden(const normals_scene *s, const nsvcd_contact *c, const double *speed,
                             double least) {
  const uint32_t numbers[2] = {c->triangle_a, c->triangle_b};
  const double n[3] = {(double)c->normal[0], (double)c->normal[1], (double)c->normal[2]};
  for (int k = 0; k < 2; k++) {
    const nsvcd_mover *mover = k ? &s->question.b : &s->question.a;
    oracle_triangle face;
    if (!normals_triangle(&s->bodies[k], mover, (double)c->time, numbers[k], &face)) continue;
    double side = k ? 1 : -1;
    if (!s->bodies[k].closed) side = oracle_dot(face.normal, n) < 0 ? -1 : 1;
    if (side * oracle_dot(speed, face.normal) < -least) return 0;
  }
  return 1;
}

static void normals_check(normals_scene *s, const nsvcd_contact *c, int is_first) {
  double speed[3];
  const double along = normals_along(s, c, speed);
  const double least = 1e-3 * oracle_length(speed) + 1e-6;
  s->contacts++;
  if (along <= least) return;
  s->leaving++;
  CHECK(!is_first);
  CHECK(normals_forbidden(s, c, speed, least));
}

// Two bodies that move past each other, turning or not, both or one of them.
static void normals_move(shapes_rng *rng, normals_scene *s) {
  nsvcd_question *q = &s->question;
  const int turns = shapes_pick(rng, 3);
  double way[3];
  memset(q, 0, sizeof *q);
  shapes_direction(rng, way);
  q->a.count = (size_t)(2 + shapes_pick(rng, 2));
  q->b.count = (size_t)(1 + shapes_pick(rng, 3));
  for (int n = 0; n < 2; n++) {
    nsvcd_mover *mover = n ? &q->b : &q->a;
    oracle_pose start;
    for (size_t k = 0; k < mover->count; k++) {
      const double along = n ? 0 : 1 - 2 * (double)k / (double)(mover->count - 1);
      oracle_pose pose;
      shapes_quaternion(rng, pose.rotation);
      for (int i = 0; i < 3; i++)
        pose.position[i] = along * way[i] + shapes_uniform(rng, -0.15, 0.15);
      if (k == 0) start = pose;
      if (turns < 2) pose = oracle_pose_between(&start, &pose, 0.2 * turns);
      for (int i = 0; i < 3 && turns < 2; i++)
        pose.position[i] = along * way[i] + shapes_uniform(rng, -0.15, 0.15);
      s->poses[n][k] = pose_rounded(&pose);
    }
    mover->poses = s->poses[n];
    mover->body = s->bodies[n].body;
  }
}

// Of thousands of contacts none is along the motion of its point; of those of a manifold none but
// where both faces are left, which turn away behind the first.
static void normals_are_against_the_motion(void) {
  const float tos[4] = {0, 1e-2f, 1e-3f, 1e-5f};
  shapes_rng rng = {4511};
  normals_scene s;
  memset(&s, 0, sizeof s);
  for (int n = 0; n < KINDS * KINDS; n++) {
    s.bodies[0] = normals_make(&rng, n % KINDS);
    s.bodies[1] = normals_make(&rng, n / KINDS);
    for (int round = 0; round < 16; round++) {
      normals_move(&rng, &s);
      nsvcd_question *q = &s.question;
      q->ask = round % 4 ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
      q->manifold = round % 4 && round % 2;
      if (round % 4) q->to = tos[shapes_pick(&rng, 4)];
      if (round % 8 > 3) q->clearance = (float)shapes_uniform(&rng, 0.001, 0.03);
      if (round % 5 == 0) q->slop = 0.002f;
      const nsvcd_answer answer = normals_ask(q);
      const int starts_free = q->ask == NSVCD_ASK_HIT || answer.time.low > 0;
      if (answer.verdict != NSVCD_HIT || answer.inside || !starts_free) continue;
      normals_check(&s, &answer.nearest, 1);
      for (size_t k = 0; k < answer.contact_count; k++)
        normals_check(&s, &answer.contacts[k], !q->manifold);
    }
    normals_free(&s.bodies[0]);
    normals_free(&s.bodies[1]);
  }
  printf("  %zu contacts, %zu of them of manifolds leave both faces\n", s.contacts, s.leaving);
  CHECK_GE(s.contacts, 2000);
}

// ---------------------------------------------------------------------------------- known normals

// How the first contact comes about: of a, which comes from `from` by `way` and goes as far again,
// and b, at the origin.
typedef struct normals_case {
  const char *name;
  int a, b;
  double turns[2][4];  // axis and angle of each
  double from[3], way[3], normal[3];
} normals_case;

enum { CUBE, FLOOR, LIFTED_FLOOR, BALL, ROD };
static normals_body normals_known_body(int kind) {
  const float ends[2][3] = {{0, -1, 0}, {0, 1, 0}};
  normals_body out;
  shapes_mesh mesh;
  memset(&mesh, 0, sizeof mesh);
  memset(&out, 0, sizeof out);
  if (kind == BALL) CHECK_EQ(nsvcd_encode_sphere(1, NULL, &out.body), NSVCD_OK);
  if (kind == ROD) CHECK_EQ(nsvcd_encode_capsule(ends[0], ends[1], 0.5f, NULL, &out.body), 0);
  if (kind == BALL || kind == ROD) return out;
  if (kind == CUBE) shapes_box(&mesh, 2, 2, 2, 1);
  for (int k = 0; k < 4 && kind != CUBE; k++)
    shapes_vertex(&mesh, k & 1 ? 5 : -5, k & 2 ? 5 : -5, 0);
  if (kind != CUBE) shapes_quad(&mesh, 0, 1, 3, 2);
  return normals_encode(&mesh, kind == CUBE, kind == FLOOR, 0);
}

// r: of 1. A cube on its corner is as high as r3, on its edge as r2.
#define R2 1.4142135623730951
#define R3 1.7320508075688772
#define NO_TURN \
  { 0, 0, 1, 0 }
#define ON_EDGE \
  { 0, 1, 0, 0.7853981633974483 }
#define ON_CORNER \
  { 0.7071067811865476, -0.7071067811865476, 0, 0.9553166181245093 }
static const normals_case normals_cases[] = {
    {"a corner on a face",
     CUBE,
     CUBE,
     {ON_CORNER, NO_TURN},
     {-0.5, -0.2, 4},
     {0.5, 0.3, -1.5},
     {0, 0, 1}},
    {"a face on a corner",
     CUBE,
     CUBE,
     {NO_TURN, ON_CORNER},
     {-0.5, -0.2, 4},
     {0.5, 0.3, -1.5},
     {0, 0, 1}},
    {"an edge on a face",
     CUBE,
     CUBE,
     {ON_EDGE, NO_TURN},
     {-0.5, 0.2, 4},
     {0.6, 0.5, -1.7},
     {0, 0, 1}},
    {"a face on a face", CUBE, CUBE, {NO_TURN, NO_TURN}, {0.3, 0.1, 4}, {0.4, 0.3, -2}, {0, 0, 1}},
    {"an edge across an edge",
     CUBE,
     CUBE,
     {{0, 1, 0, 0.7853981633974483}, {1, 0, 0, 0.7853981633974483}},
     {0.3, 0.1, 4},
     {-0.5, 0.1, -1.3},
     {0, 0, 1}},
    {"a corner on a corner",
     CUBE,
     CUBE,
     {NO_TURN, NO_TURN},
     {4, 4, 4},
     {-2, -2, -2},
     {1 / R3, 1 / R3, 1 / R3}},
    {"a corner on a corner, from aside",
     CUBE,
     CUBE,
     {NO_TURN, NO_TURN},
     {3, 4, 5},
     {-1, -2, -3},
     {0.2672612419124244, 0.5345224838248488, 0.8017837257372732}},
    {"an edge on an edge along it",
     CUBE,
     CUBE,
     {NO_TURN, NO_TURN},
     {4, 0.5, 5},
     {-2, 0.4, -3},
     {0.5547001962252291, 0, 0.8320502943378437}},
    {"a cube from behind a floor",
     CUBE,
     FLOOR,
     {NO_TURN, NO_TURN},
     {0, 0, -3},
     {0.5, 0, 2},
     {0, 0, -1}},
    {"a corner from behind",
     CUBE,
     LIFTED_FLOOR,
     {ON_CORNER, NO_TURN},
     {0, 0, -4},
     {0.5, 0, 4 - R3},
     {0, 0, -1}},
    {"a cube before a floor",
     CUBE,
     LIFTED_FLOOR,
     {NO_TURN, NO_TURN},
     {0, 0, 3},
     {0.5, 0, -2},
     {0, 0, 1}},
    {"a ball from behind", BALL, FLOOR, {NO_TURN, NO_TURN}, {0, 0, -3}, {0.5, 0, 2}, {0, 0, -1}},
    {"a rod from behind",
     ROD,
     LIFTED_FLOOR,
     {NO_TURN, NO_TURN},
     {0, 0, -3},
     {0.5, 0, 2.5},
     {0, 0, -1}},
    {"a ball on a corner",
     BALL,
     CUBE,
     {NO_TURN, NO_TURN},
     {3, 3, 3},
     {-2 + 1 / R3, -2 + 1 / R3, -2 + 1 / R3},
     {1 / R3, 1 / R3, 1 / R3}},
    {"a floor on a cube, its back ahead",
     FLOOR,
     CUBE,
     {NO_TURN, ON_EDGE},
     {0, 0, 3},
     {0.1, 0.2, R2 - 3},
     {0, 0, 1}},
};

// By hand, for a and b the other way round, where b comes instead or both, with a clearance, with a
// manifold and without; and where both have been led apart again since, by a pose at the contact.
static void normals_known(void) {
  const nsvcd_ask asks[2] = {NSVCD_ASK_FIRST, NSVCD_ASK_HIT};
  for (size_t n = 0; n < sizeof normals_cases / sizeof *normals_cases; n++) {
    const normals_case *c = &normals_cases[n];
    normals_body bodies[2] = {normals_known_body(c->a), normals_known_body(c->b)};
    for (int way = 0; way < 64; way++) {
      const int swapped = way & 1;
      const int goes_back = (way & 8) && !(way & 32);
      const double fraction = way & 2 ? way & 4 ? 1 : 0.4 : 0;  // of the way that b goes
      nsvcd_pose poses[2][3];
      nsvcd_question q;
      memset(&q, 0, sizeof q);
      for (int k = 0; k < 6; k++) {
        oracle_pose pose;
        const double gone = k % 3 == 0 ? 0 : goes_back ? (k % 3 == 1 ? 1.003 : 0.5) : k % 3;
        const double by = k < 3 ? 1 - fraction : -fraction;
        oracle_axis_angle(c->turns[k / 3], c->turns[k / 3][3], pose.rotation);
        for (int i = 0; i < 3; i++)
          pose.position[i] = (k < 3 ? c->from[i] : 0) + by * gone * c->way[i];
        poses[k / 3][k % 3] = pose_rounded(&pose);
      }
      for (int k = 0; k < 2; k++) {
        nsvcd_mover *mover = k == swapped ? &q.a : &q.b;
        mover->body = bodies[k].body;
        mover->poses = poses[k];
        mover->count = 3;
      }
      q.ask = asks[way >> 5];
      q.clearance = way & 16 ? 0.01f : 0;
      if (q.ask == NSVCD_ASK_FIRST) q.to = goes_back ? 0.1f : 1e-4f;
      q.manifold = q.ask == NSVCD_ASK_FIRST && (way & 4);
      const nsvcd_answer answer = normals_ask(&q);
      const double side = swapped ? -1 : 1;
      double along = 0;
      CHECK_EQ(answer.verdict, NSVCD_HIT);
      for (int k = 0; k < 3; k++) along += side * c->normal[k] * (double)answer.nearest.normal[k];
      // the one that HIT finds is any
      if (q.ask == NSVCD_ASK_FIRST && !(along > 0.99)) {
        printf("  %s, %d: normal %g %g %g\n", c->name, way, (double)answer.nearest.normal[0],
               (double)answer.nearest.normal[1], (double)answer.nearest.normal[2]);
        CHECK(0);
      }
      double against = 0;
      for (int k = 0; k < 3; k++) against += side * c->way[k] * (double)answer.nearest.normal[k];
      CHECK_LE(against, 1e-3);
      for (size_t i = 0; i < answer.contact_count && q.manifold; i++) {
        const float *other = answer.contacts[i].normal;
        double away = 0;
        for (int k = 0; k < 3; k++) away += side * c->way[k] * (double)other[k];
        CHECK_LE(away, 1e-3);
      }
    }
    normals_free(&bodies[0]);
    normals_free(&bodies[1]);
  }
}

// In touch from the start, by a hair, along a floor, into it or away from it, of one face or a fine
// one: out of the floor, where the motion does not tell.
static void normals_at_the_start(void) {
  for (int n = 0; n < 24; n++) {
    shapes_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    shapes_box(&mesh, 10, 10, 1, n % 2 ? 1 : 7);
    normals_body floor = normals_encode(&mesh, 1, 0, 0);
    normals_body cube = normals_known_body(CUBE);
    const float down = n / 4 % 3 == 0 ? 0 : n / 4 % 3 == 1 ? -0.1f : 0.1f;
    const nsvcd_pose path[2] = {{{0.3f, 0.1f, 1.5f - 1e-4f}, {0, 0, 0, 1}},
                                {{1.3f, 0.2f, 1.5f - 1e-4f + down}, {0, 0, 0, 1}}};
    nsvcd_question q;
    memset(&q, 0, sizeof q);
    q.a.body = n % 4 < 2 ? cube.body : floor.body;
    q.b.body = n % 4 < 2 ? floor.body : cube.body;
    nsvcd_mover *mover = n % 4 < 2 ? &q.a : &q.b;
    mover->poses = path;
    mover->count = 2;
    q.ask = NSVCD_ASK_FIRST;
    q.manifold = n > 11;
    const nsvcd_answer answer = normals_ask(&q);
    CHECK_EQ(answer.verdict, NSVCD_HIT);
    CHECK_EQ(answer.time.high, 0);
    for (size_t k = 0; k < answer.contact_count; k++)
      CHECK_NEAR(answer.contacts[k].normal[2], n % 4 < 2 ? 1 : -1, 1e-4);
    normals_free(&cube);
    normals_free(&floor);
  }
}

// Of sheets that meet, said to be open or not, round or not, or come within a clearance: where a
// manifold names the triangles of the first contact, it has their normal and their gap.
static void normals_of_sheets(void) {
  shapes_rng rng = {4512};
  size_t same = 0;
  for (int n = 0; n < 900; n++) {
    normals_body a = normals_make(&rng, n % 3 == 1 ? ROUND_SOUP : SOUP);
    normals_body b = normals_make(&rng, n % 3 == 1 ? ROUND_SOUP : SOUP);
    const float x = (float)shapes_uniform(&rng, -0.3, 0.3);
    const nsvcd_pose path[2] = {{{x, 0.1f, 1}, {0, 0, 0, 1}},
                                {{0.3f * x, 0.05f, -1}, {0, 0, 0, 1}}};
    nsvcd_question q = question_of(a.body, path, 2, b.body, NULL, NULL);
    q.ask = NSVCD_ASK_FIRST;
    q.manifold = 1;
    q.clearance = n % 3 == 0 ? 0.03f : 0;
    const nsvcd_answer answer = normals_ask(&q);
    const nsvcd_contact *first = &answer.nearest;
    for (size_t k = 0; k < answer.contact_count && answer.time.low > 0; k++) {
      const nsvcd_contact *c = &answer.contacts[k];
      double along = 0;
      if (c->triangle_a != first->triangle_a || c->triangle_b != first->triangle_b) continue;
      same++;
      for (int i = 0; i < 3; i++) along += (double)c->normal[i] * (double)first->normal[i];
      CHECK_GE(along, 0.5);
      CHECK_NEAR(c->gap, first->gap, 1e-3);
    }
    normals_free(&a);
    normals_free(&b);
  }
  CHECK_GE(same, 200);
}

void test_normals(void) {
  RUN(normals_are_against_the_motion);
  RUN(normals_known);
  RUN(normals_at_the_start);
  RUN(normals_of_sheets);
}

CHECK_ALONE(test_normals)
