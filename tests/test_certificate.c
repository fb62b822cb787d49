// Certificates: what nsvcd_certify makes examples/verify accepts, and is what nsvcd_sweep says;
// what is false it never accepts, whoever made it. The oracle is in double, at many times.
#define NSVCD_NO_NETWORK
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../neuralsvcd.h"
#include "../extras/neuralsvcd_certify.h"
#include "../extras/neuralsvcd_robot.h"

#include "../examples/verify/nsvcd_verify_robot.h"
#include "../examples/scenery/shapes.h"
#include "../examples/scenery/oracle.h"
#include "../examples/scenery/poses.h"
#include "check.h"
#include "certificate_scene.h"
#include "robot_scene.h"

void test_certificate(void);

#define CERT_LOOKS 48  // times, at which the oracle looks

// The least distance at times of a grid, metres, up to a limit, and whether one is ever inside.
static double cert_least(const cert_scene *s, double limit, int *inside) {
  double least = limit;
  *inside = 0;
  for (int k = 0; k <= CERT_LOOKS; k++) {
    int is_in;
    const double apart = cert_apart(s, (double)k / CERT_LOOKS, least, &is_in);
    if (is_in && apart > 1e-4) *inside = 1;
    least = fmin(least, apart);
  }
  return least;
}

// ---- what is made is accepted, and is true

static void certificates_are_true(void) {
  shapes_rng rng = {1};
  size_t count[5] = {0};
  size_t missed = 0;
  for (size_t trial = 0; trial < check_many(400); trial++) {
    static uint8_t bytes[CERT_ROOM];
    static uint64_t memory[65536];
    cert_scene s;
    cert_view view;
    nsvcd_answer answer;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    int inside;
    cert_random(&s, &rng);
    const size_t size = nsvcd_sweep_workspace_size(&s.question);
    CHECK_LE(size, sizeof memory);
    CHECK_EQ(nsvcd_sweep(&s.question, memory, sizeof memory, &answer), NSVCD_OK);
    CHECK_EQ(cert_certify(&s, trial % 2 ? &answer : NULL, bytes, sizeof bytes, &made), NSVCD_OK);
    // a second opinion
    if (made.verdict != NSVCD_UNDECIDED && answer.verdict != NSVCD_UNDECIDED)
      CHECK_EQ(made.verdict, answer.verdict);
    // what is free is always proven, and so is a hit that is pointed at
    if (trial % 2 || answer.verdict == NSVCD_FREE) CHECK(made.verdict != NSVCD_UNDECIDED);
    missed += made.verdict == NSVCD_UNDECIDED;
    if (made.verdict == NSVCD_UNDECIDED) continue;
    CHECK_LE(made.size, sizeof bytes);
    cert_look(&s, &view);
    CHECK(!view.why);
    CHECK(cert_check(&view, s.question.clearance, bytes, made.size, &report));
    CHECK_EQ(report.kind == NSVCD_VERIFY_FREE, made.verdict == NSVCD_FREE);
    CHECK_EQ(report.kind == NSVCD_VERIFY_INSIDE, made.inside);
    count[report.kind]++;
    const double clearance = (double)s.question.clearance;
    if (report.kind == NSVCD_VERIFY_FREE) {
      CHECK_GE(cert_least(&s, 1, &inside), clearance);
      CHECK(!inside);
    } else {
      const double apart = cert_apart(&s, report.time, 1, &inside);
      CHECK_NEAR(report.time, made.time, 1e-9);
      if (report.kind == NSVCD_VERIFY_HIT) CHECK_LE(apart, 1e-9);
      if (report.kind == NSVCD_VERIFY_NEAR) CHECK_LE(apart, clearance);
      if (report.kind == NSVCD_VERIFY_INSIDE)
        CHECK_GE(fabs(cert_winding(&s, report.time, report.a, (int)report.b)), 0.99);
    }
  }
  for (int k = NSVCD_VERIFY_FREE; k <= NSVCD_VERIFY_INSIDE; k++) CHECK_GE(count[k], check_many(4));
  CHECK_LE(missed, check_many(400) / 100);
}

// ---- what is false is refused

// Moves b towards where it collides, by as little as the oracle sees: 1e-3 down to 1e-7 m.
static int cert_collide(cert_scene *s, shapes_rng *rng) {
  double on_a[3], on_b[3], way[3];
  double least = 1;
  double when = 0;
  for (int k = 0; k <= CERT_LOOKS; k++) {
    const double apart = cert_apart(s, (double)k / CERT_LOOKS, least, NULL);
    if (apart < least) when = (double)k / CERT_LOOKS;
    least = fmin(least, apart);
  }
  if (!(least > 0) || least > 0.05) return 0;
  const oracle_pose a = cert_pose_at(&s->question.a, when);
  const oracle_pose b = cert_pose_at(&s->question.b, when);
  if (s->question.a.scale > 0 || s->question.b.scale > 0) return 0;
  oracle_distance(&s->a->exact, &a, &s->b->exact, &b, on_a, on_b);
  oracle_sub(on_a, on_b, way);
  const double length = oracle_length(way);
  if (!(length > 1e-9)) return 0;
  const double deeper = pow(10, shapes_uniform(rng, -6, -3));
  for (size_t k = 0; k < s->question.b.count; k++) {
    for (int i = 0; i < 3; i++)
      s->poses[1][k].position[i] += (float)(way[i] * (length + deeper) / length);
  }
  return cert_apart(s, when, 1, NULL) <= 0;
}

// A certificate with one to three mistakes; other: another certificate, to take parts of.
static size_t cert_mutate(shapes_rng *rng, const uint8_t *from, size_t size, const uint8_t *other,
                          size_t other_size, uint8_t *out) {
  memcpy(out, from, size);
  for (int n = 1 + shapes_pick(rng, 3); n > 0; n--) {
    const size_t at = (size_t)shapes_pick(rng, (int)size);
    const int kind = shapes_pick(rng, 6);
    if (kind < 2) out[at] = (uint8_t)(out[at] ^ 1 << shapes_pick(rng, 8));
    if (kind == 2) out[at] = (uint8_t)shapes_pick(rng, 256);
    if (kind == 3 && size > 6) size = 6 + (size_t)shapes_pick(rng, (int)size - 6);
    if (kind == 4 && size + 1 < CERT_ROOM) {
      memmove(out + at + 1, out + at, size - at);
      size++;
    }
    if (kind == 5 && other_size > 6) {
      const size_t begin = (size_t)shapes_pick(rng, (int)other_size - 1);
      const size_t most = size - at < other_size - begin ? size - at : other_size - begin;
      memcpy(out + at, other + begin, 1 + (size_t)shapes_pick(rng, (int)most));
    }
  }
  return size;
}

static void certificates_cannot_be_forged(void) {
  static uint8_t free_bytes[CERT_ROOM], hit_bytes[CERT_ROOM], other[CERT_ROOM], forged[CERT_ROOM];
  shapes_rng rng = {2};
  size_t other_size = 0;
  size_t scenes = 0;
  size_t tried = 0;
  size_t accepted = 0;
  for (size_t trial = 0; scenes < check_many(50) && trial < check_many(7000); trial++) {
    cert_scene s, hit;
    cert_view view, of_hit;
    nsvcd_certificate made, made_hit;
    nsvcd_verify_report report;
    cert_random(&s, &rng);
    s.question.a.scale = s.question.b.scale = s.question.clearance = 0;
    CHECK_EQ(cert_certify(&s, NULL, free_bytes, sizeof free_bytes, &made), NSVCD_OK);
    if (made.verdict != NSVCD_FREE) continue;
    hit = s;
    cert_own(&hit);
    if (!cert_collide(&hit, &rng)) continue;
    // what it proves of the scene that collides has that one's digests
    CHECK_EQ(cert_certify(&hit, NULL, hit_bytes, sizeof hit_bytes, &made_hit), NSVCD_OK);
    CHECK(made_hit.verdict != NSVCD_FREE);
    if (made_hit.verdict != NSVCD_HIT) continue;
    scenes++;
    cert_look(&s, &view);
    cert_look(&hit, &of_hit);
    CHECK(!cert_check(&of_hit, 0, free_bytes, made.size, &report));
    for (int n = 0; n < 120; n++) {
      // of the scene that is free: never that it is not
      size_t size = cert_mutate(&rng, free_bytes, made.size, other, other_size, forged);
      if (n % 3) cert_forge(forged, free_bytes);
      if (n % 5 == 0) forged[0] = (uint8_t)(forged[0] ^ (1 + shapes_pick(&rng, 3)));
      const int taken = cert_check(&view, 0, forged, size, &report);
      CHECK(!taken || report.kind == NSVCD_VERIFY_FREE);
      accepted += (size_t)taken;
      // of the one that collides: never that it is free
      size = n ? cert_mutate(&rng, free_bytes, made.size, other, other_size, forged) : made.size;
      if (!n) memcpy(forged, free_bytes, size);
      cert_forge(forged, hit_bytes);
      forged[0] = free_bytes[0];
      CHECK(!cert_check(&of_hit, 0, forged, size, &report));
      tried += 2;
    }
    memcpy(other, free_bytes, made.size);
    other_size = made.size;
  }
  CHECK_GE(scenes, check_many(50));
  CHECK_GE(tried, check_many(10000));
  CHECK_GE(accepted, tried / 1000);  // some change nothing
}

// Writes certificates of this kind about a scene into `bytes`.
static nsvcd__certifier cert_writer(const cert_scene *s, int kind, uint8_t *bytes, size_t room) {
  nsvcd__certifier c;
  memset(&c, 0, sizeof c);
  c.bodies[0].tree = s->a->tree;
  c.bodies[1].tree = s->b->tree;
  c.bytes = bytes;
  c.capacity = room;
  nsvcd__write_head(&c, (uint32_t)kind);
  return c;
}

// One plane, all the while.
static size_t cert_one_plane(const cert_scene *s, const uint8_t *head, nsvcd__d3 along,
                             uint8_t *out) {
  nsvcd__certifier c = cert_writer(s, NSVCD__PROVES_FREE, out, 64);
  const nsvcd__coded_normal normal = nsvcd__normal_of(along, 8);
  nsvcd__write_bits(&c, 5, 3);
  nsvcd__write_normal(&c, NSVCD__REMEMBERED, &normal);
  cert_forge(out, head);
  return (c.bits + 7) / 8;
}

// Turns by 180 degrees, either way as long: all three take the same.
static void certificates_of_half_turns(void) {
  static uint8_t bytes[CERT_ROOM];
  static uint64_t memory[65536];
  shapes_rng rng = {12};
  size_t count[3] = {0};
  for (int trial = 0; trial < 200; trial++) {
    cert_scene s;
    cert_view view;
    nsvcd_answer answer;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    cert_random(&s, &rng);
    s.question.a.count = 2;
    s.question.a.times = NULL;
    // q, and q after half a turn about an axis: products that sum to nothing, or hardly anything
    const float *q = s.poses[0][0].rotation;
    const float after[4] = {q[3], q[2], -q[1], -q[0]};
    memcpy(s.poses[0][1].rotation, after, sizeof after);
    CHECK_EQ(nsvcd_sweep(&s.question, memory, sizeof memory, &answer), NSVCD_OK);
    CHECK_EQ(cert_certify(&s, &answer, bytes, sizeof bytes, &made), NSVCD_OK);
    CHECK_EQ(made.verdict, answer.verdict);
    count[made.verdict]++;
    cert_look(&s, &view);
    CHECK(!view.why);
    CHECK(cert_check(&view, s.question.clearance, bytes, made.size, &report));
  }
  CHECK_GE(count[NSVCD_FREE], 20);
  CHECK_GE(count[NSVCD_HIT], 20);
}

// The walk of a body that goes along x from one end to the other, past another at the origin: parted
// along x where it is far, along z where it is nearer than so many metres.
static void cert_write_pass(nsvcd__certifier *c, double t0, double t1, double near_by) {
  const double x0 = 1.8e6 * t0 - 9e5;
  const double x1 = 1.8e6 * t1 - 9e5;
  const int is_near = fmax(fabs(x0), fabs(x1)) < near_by;
  const int passes = fmin(x0, x1) < 0.2 * near_by && fmax(x0, x1) > -0.2 * near_by;
  if (!is_near && passes) {
    nsvcd__write_bits(c, 4, 3);
    cert_write_pass(c, t0, 0.5 * (t0 + t1), near_by);
    cert_write_pass(c, 0.5 * (t0 + t1), t1, near_by);
    return;
  }
  const double side = x0 + x1 < 0 ? -1 : 1;
  const nsvcd__coded_normal normal =
      nsvcd__normal_of(is_near ? nsvcd__d3_of(0, 0, 1) : nsvcd__d3_of(side, 0, 0), 8);
  nsvcd__write_bits(c, 5, 3);
  nsvcd__write_normal(c, NSVCD__REMEMBERED, &normal);
}

// What an answer says is not believed: with one that lies, of what is free and of what is not, a
// certificate is as good as without; but where it says that something is inside of what is not
// closed there may be none.
static void certificates_of_answers_that_lie(void) {
  static uint8_t bytes[CERT_ROOM];
  shapes_rng rng = {13};
  size_t count[3] = {0};
  for (int trial = 0; trial < 300; trial++) {
    cert_scene s;
    cert_view view;
    nsvcd_answer lie;
    nsvcd_certificate made, honest;
    nsvcd_verify_report report;
    cert_random(&s, &rng);
    memset(&lie, 0, sizeof lie);
    lie.verdict = NSVCD_HIT;
    lie.inside = trial % 2;
    lie.nearest.time = (float)shapes_uniform(&rng, 0, 1);
    lie.nearest.triangle_a = (uint32_t)shapes_pick(&rng, 20);
    lie.nearest.triangle_b = (uint32_t)shapes_pick(&rng, 20);
    CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &honest), NSVCD_OK);
    CHECK_EQ(cert_certify(&s, &lie, bytes, sizeof bytes, &made), NSVCD_OK);
    if (honest.verdict == NSVCD_UNDECIDED) continue;
    if (lie.inside && made.why == NSVCD_WHY_OPEN) {
      CHECK_EQ(honest.verdict, NSVCD_FREE);
      continue;
    }
    CHECK_EQ(made.verdict, honest.verdict);
    count[made.verdict]++;
    cert_look(&s, &view);
    CHECK(cert_check(&view, s.question.clearance, bytes, made.size, &report));
  }
  CHECK_GE(count[NSVCD_FREE], 30);
  CHECK_GE(count[NSVCD_HIT], 30);
}

// Small bodies in a solid, in a shell's cavity, in its wall, in one of a body's two parts.
static void certificates_of_what_is_inside(void) {
  cert_body *bodies = cert_bodies();
  static const struct {
    int inner, outer;
    float x, scale;
    int inside;
  } cases[] = {{9, 0, 0, 1, 1},        {9, 6, 0, 1, 0},     {9, 6, 0.14f, 0.1f, 1},
               {9, 7, 0.15f, 1, 1},    {9, 7, 0, 1, 0},     {7, 0, 0.15f, 1, 1},
               {9, 10, 0, 1, 1},       {10, 0, 0, 0.5f, 1}, {9, 11, 0, 0.5f, 0},
               {9, 3, 0.12f, 0.5f, 1}, {9, 8, 0, 1, 1}};
  uint8_t bytes[4096], outside[4096];
  for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
    for (int swapped = 0; swapped < 2; swapped++) {
      cert_scene s;
      cert_view view;
      nsvcd_certificate made;
      nsvcd_verify_report report;
      const cert_body *inner = &bodies[cases[n].inner];
      const cert_body *outer = &bodies[cases[n].outer];
      cert_rest(&s, swapped ? outer : inner, swapped ? inner : outer);
      nsvcd_mover *mover = swapped ? &s.question.b : &s.question.a;
      s.poses[swapped][0].position[0] = cases[n].x;
      mover->scale = cases[n].scale;
      CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
      CHECK_EQ(made.verdict, cases[n].inside ? NSVCD_HIT : NSVCD_FREE);
      CHECK_EQ(made.inside, cases[n].inside);
      cert_look(&s, &view);
      CHECK(cert_check(&view, 0, bytes, made.size, &report));
      CHECK_EQ(report.kind, cases[n].inside ? NSVCD_VERIFY_INSIDE : NSVCD_VERIFY_FREE);
      if (!cases[n].inside) continue;
      // no walk and no rays at all prove that it is outside
      shapes_rng rng = {n + 1};
      uint8_t walk[64];
      cert_scene away = s;
      cert_own(&away);
      away.poses[swapped][0].position[2] = 1;
      CHECK_EQ(cert_certify(&away, NULL, outside, sizeof outside, &made), NSVCD_OK);
      CHECK_EQ(made.verdict, NSVCD_FREE);
      cert_forge(outside, bytes);
      CHECK(!cert_check(&view, 0, outside, made.size, &report));
      for (int k = 0; k < 300; k++) {
        memcpy(walk, outside, 5);
        for (size_t i = 5; i < sizeof walk; i++) walk[i] = (uint8_t)shapes_pick(&rng, 256);
        CHECK(!cert_check(&view, 0, walk, 6 + (size_t)shapes_pick(&rng, 58), &report));
      }
    }
  }
}

// ---- the scene it is about

#define IS_REFUSED(change, back, text)                                           \
  do {                                                                           \
    change;                                                                      \
    cert_look(&s, &view);                                                        \
    CHECK(view.why || !cert_check(&view, clearance, bytes, made.size, &report)); \
    CHECK(strstr(view.why ? view.why : report.reason, text) != NULL);            \
    back;                                                                        \
  } while (0)

static void certificates_of_other_scenes(void) {
  cert_body *bodies = cert_bodies();
  uint8_t bytes[4096];
  float clearance = 0.01f;
  cert_scene s;
  cert_view view;
  nsvcd_certificate made;
  nsvcd_verify_report report;
  shapes_rng rng = {9};
  cert_rest(&s, &bodies[3], &bodies[4]);
  cert_random_poses(&rng, s.poses[0], s.times[0], 3, 0.1, 1);
  cert_random_poses(&rng, s.poses[1], s.times[1], 2, 0.1, 1);
  for (int k = 0; k < 3; k++) s.poses[0][k].position[2] += 1;
  s.question.a.times = s.times[0];
  s.question.a.count = 3;
  s.question.b.count = 2;
  s.question.clearance = clearance;
  CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
  CHECK_EQ(made.verdict, NSVCD_FREE);
  IS_REFUSED(s.a = &bodies[5], s.a = &bodies[3], "another mesh a");
  IS_REFUSED(s.b = &bodies[5], s.b = &bodies[4], "another mesh b");
  IS_REFUSED(s.poses[0][1].position[0] += 0.01f, s.poses[0][1].position[0] -= 0.01f, "motion");
  IS_REFUSED(s.question.a.scale = 1.01f, s.question.a.scale = 0, "scale");
  IS_REFUSED(s.question.b.scale = 1.01f, s.question.b.scale = 0, "scale");
  IS_REFUSED(s.question.a.times = NULL, s.question.a.times = s.times[0], "motion");
  IS_REFUSED(s.question.a.count = 2, s.question.a.count = 3, "");
  IS_REFUSED(clearance = 0, clearance = 0.01f, "clearance");
  IS_REFUSED(clearance = NAN, clearance = 0.01f, "clearance is out of range");
  IS_REFUSED(clearance = -1, clearance = 0.01f, "clearance is out of range");
  IS_REFUSED(bytes[0] ^= 4, bytes[0] ^= 4, "version 1");
  IS_REFUSED(made.size++, made.size--, "");
  for (size_t size = 0; size < made.size; size++) {
    CHECK(!cert_check(&view, clearance, bytes, size, &report));
    CHECK(report.reason && report.position <= size);
  }
  // what the checker refuses of a motion
  const nsvcd_pose kept = s.poses[0][1];
  IS_REFUSED(s.poses[0][1].position[0] = NAN, s.poses[0][1] = kept, "pose is out of range");
  IS_REFUSED(s.poses[0][1].rotation[0] = 2, s.poses[0][1] = kept, "unit length");
  IS_REFUSED(s.question.a.scale = NAN, s.question.a.scale = 0, "");
  IS_REFUSED(s.times[0][1] = 1, s.times[0][1] = 0.5f, "times do not rise");
}

// ---- nsvcd_certify and nsvcd_tree_build, and the checker's meshes: bad input, and room

static void certificates_refuse(void) {
  float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
  nsvcd_mesh mesh = {positions, indices, 4, 2};
  const nsvcd_tree *tree = NULL;
  nsvcd_verify_mesh checked;
  uint64_t memory[256];
  CHECK_LE(nsvcd_tree_size(&mesh), sizeof memory);
  CHECK_EQ(nsvcd_tree_size(NULL), 0);
  CHECK_EQ(nsvcd_tree_build(&mesh, memory, sizeof memory, &tree), NSVCD_OK);
  CHECK_EQ(nsvcd_tree_build(NULL, memory, sizeof memory, &tree), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_tree_build(&mesh, memory, sizeof memory, NULL), NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_tree_build(&mesh, NULL, sizeof memory, &tree), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_tree_build(&mesh, (char *)memory + 4, 1000, &tree), NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_tree_build(&mesh, memory, nsvcd_tree_size(&mesh) - 1, &tree),
           NSVCD_ERROR_WORKSPACE);
  CHECK(!nsvcd_verify_mesh_init(positions, 4, indices, 2, memory, &checked));
  indices[5] = 4;
  CHECK_EQ(nsvcd_tree_build(&mesh, memory, sizeof memory, &tree), NSVCD_ERROR_INDEX);
  CHECK(nsvcd_verify_mesh_init(positions, 4, indices, 2, memory, &checked) != NULL);
  indices[5] = 3;
  positions[4] = NAN;
  CHECK_EQ(nsvcd_tree_build(&mesh, memory, sizeof memory, &tree), NSVCD_ERROR_NUMBER);
  CHECK(nsvcd_verify_mesh_init(positions, 4, indices, 2, memory, &checked) != NULL);
  CHECK(nsvcd_verify_mesh_init(positions, 4, indices, 0, memory, &checked) != NULL);

  cert_scene s;
  shapes_rng rng = {4};
  nsvcd_certificate made, whole;
  uint8_t bytes[CERT_ROOM], few[CERT_ROOM];
  cert_rest(&s, &cert_bodies()[3], &cert_bodies()[5]);
  cert_random_poses(&rng, s.poses[0], s.times[0], 3, 0.1, 1);
  for (int k = 0; k < 3; k++) s.poses[0][k].position[2] += 0.32f;
  s.question.a.count = 3;
#define CERTIFY_IS(change, back, result)                                  \
  do {                                                                    \
    change;                                                               \
    CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), result); \
    back;                                                                 \
  } while (0)
  CERTIFY_IS((void)0, (void)0, NSVCD_OK);
  CHECK_EQ(made.verdict, NSVCD_FREE);
  whole = made;
  CERTIFY_IS(s.question.slop = 0.1f, s.question.slop = 0, NSVCD_ERROR_SLOP);
  CERTIFY_IS(s.question.clearance = NAN, s.question.clearance = 0, NSVCD_ERROR_CLEARANCE);
  CERTIFY_IS(s.question.clearance = -1, s.question.clearance = 0, NSVCD_ERROR_CLEARANCE);
  CERTIFY_IS(s.question.b.scale = -1, s.question.b.scale = 0, NSVCD_ERROR_SCALE);
  CERTIFY_IS(s.question.b.scale = 1e7f, s.question.b.scale = 0, NSVCD_ERROR_SCALE);
  const nsvcd_pose kept = s.poses[0][1];
  CERTIFY_IS(s.poses[0][1].rotation[3] = 3, s.poses[0][1] = kept, NSVCD_ERROR_QUATERNION);
  // room for some of it: the size is told, and what there is room for is the beginning
  CHECK_EQ(cert_certify(&s, NULL, few, 10, &made), NSVCD_OK);
  CHECK_EQ(made.size, whole.size);
  CHECK_GE(made.size, 11);
  CHECK(memcmp(few, bytes, 10) == 0);
  CHECK_EQ(cert_certify(&s, NULL, NULL, 0, &made), NSVCD_OK);
  CHECK_EQ(made.size, whole.size);
  const nsvcd_certify_options options = {NULL, whole.visits - 1};
  const size_t size = nsvcd_certify_workspace_size(&s.question, s.a->tree, s.b->tree);
  void *workspace = malloc(size);
  CHECK_EQ(nsvcd_certify(&s.question, s.a->tree, s.b->tree, &options, workspace, size, bytes,
                         sizeof bytes, &made),
           NSVCD_OK);
  CHECK_EQ(made.verdict, NSVCD_UNDECIDED);
  CHECK_EQ(made.size, 0);
  CHECK_EQ(nsvcd_certify(&s.question, s.a->tree, s.b->tree, NULL, workspace, size - 1, bytes,
                         sizeof bytes, &made),
           NSVCD_ERROR_WORKSPACE);
  CHECK_EQ(nsvcd_certify(&s.question, NULL, s.b->tree, NULL, workspace, size, bytes, 1, &made),
           NSVCD_ERROR_ARGUMENT);
  CHECK_EQ(nsvcd_certify(&s.question, s.a->tree, s.b->tree, NULL, workspace, size, NULL, 1, &made),
           NSVCD_ERROR_ARGUMENT);
  free(workspace);
}

// ---- what the checker believes of motions

// No point leaves its chord, as the oracle places it, by more than the checker allows for; and the
// checker places it where the oracle does. Of paths, then of what joints carry.
static void cert_law_holds(const nsvcd_verify_mover *mover, double t0, double t1, const double *x,
                           const double (*true_at)[3], int count, double *tightest) {
  double deviation[6] = {0};
  double aside[3], axis[3];
  nsvcd_verify_place place;
  mover->deviation(mover->motion, t0, t1, deviation);
  mover->place(mover->motion, t0, &place);
  const double scaled[3] = {mover->scale * x[0], mover->scale * x[1], mover->scale * x[2]};
  oracle_cross(scaled, deviation + 3, aside);
  oracle_rotate(place.turn, deviation + 3, axis);
  const double any = deviation[0] + deviation[1] * oracle_length(scaled);
  const double turn = deviation[2] * oracle_length(aside);
  for (int k = 0; k < count; k++) {
    const double fraction = (double)k / (count - 1);
    double off[3], placed_at[3];
    for (int i = 0; i < 3; i++)
      off[i] = true_at[k][i] - (1 - fraction) * true_at[0][i] - fraction * true_at[count - 1][i];
    for (int i = 0; i < 4; i++) {  // along the way off, and along the axes of the world
      double n[3] = {i == 0, i == 1, i == 2};
      double across[3];
      const double length = oracle_length(off);
      for (int c = 0; c < 3 && i == 3; c++) n[c] = length > 0 ? off[c] / length : 0;
      oracle_cross(n, axis, across);
      const double most = any + turn * oracle_length(across);
      const double along = fabs(oracle_dot(n, off));
      CHECK_LE(along, most + 1e-9);
      if (most > 1e-6) *tightest = fmax(*tightest, along / most);
    }
    mover->place(mover->motion, t0 + fraction * (t1 - t0), &place);
    oracle_rotate(place.turn, scaled, placed_at);
    for (int i = 0; i < 3; i++) off[i] = placed_at[i] + place.at[i] - true_at[k][i];
    CHECK_LE(oracle_length(off), 1e-10 * (1 + oracle_length(true_at[k]) + mover->reach));
  }
}

static void certificates_know_paths(void) {
  shapes_rng rng = {5};
  double tightest = 0;
  for (int trial = 0; trial < 600; trial++) {
    cert_scene s;
    cert_view view;
    double at[9][3];
    cert_random(&s, &rng);
    const nsvcd_mover *m = &s.question.a;
    if (m->count < 2) continue;
    cert_look(&s, &view);
    CHECK(!view.why);
    const nsvcd_verify_mover *mover = &view.movers[0];
    double t0 = shapes_uniform(&rng, 0, 0.999);
    const double next = mover->next(mover->motion, t0);
    CHECK(next > t0);
    const double t1 = t0 + (next - t0) * shapes_uniform(&rng, 0.01, 1);
    const double *x = s.a->points + 3 * (size_t)shapes_pick(&rng, (int)s.a->mesh.vertex_count);
    for (int k = 0; k < 9; k++) {
      const oracle_pose pose = cert_pose_at(m, t0 + (t1 - t0) * k / 8);
      const double scaled[3] = {mover->scale * x[0], mover->scale * x[1], mover->scale * x[2]};
      oracle_transform(&pose, scaled, at[k]);
    }
    cert_law_holds(mover, t0, t1, x, (const double(*)[3])at, 9, &tightest);
  }
  CHECK_GE(tightest, 0.95);
}

// ---- robots

#define CERT_PIECES 3
typedef struct cert_motion {
  double points[(CERT_PIECES * NSVCD_MAX_DEGREE + 1) * NSVCD_MAX_JOINTS], times[CERT_PIECES + 1];
  nsvcd_joint_motion motion;
  nsvcd_verify_joint joints[NSVCD_MAX_JOINTS];
  nsvcd_verify_motion checked;
} cert_motion;

static void cert_random_motion(const robot *r, shapes_rng *rng, double reach, cert_motion *out) {
  const size_t joints = r->scene.joint_count;
  memset(out, 0, sizeof *out);
  out->motion.pieces = 1 + (size_t)shapes_pick(rng, CERT_PIECES);
  out->motion.degree = 1 + (size_t)shapes_pick(rng, NSVCD_MAX_DEGREE);
  for (size_t p = 0; p <= out->motion.pieces; p++)
    out->times[p] = p ? out->times[p - 1] + shapes_uniform(rng, 0.2, 2) : 3;
  for (size_t i = 0; i <= out->motion.pieces * out->motion.degree; i++) {
    for (size_t j = 0; j < joints; j++) {
      double *value = &out->points[i * joints + j];
      *value =
          (i ? *(value - joints) : shapes_uniform(rng, -2, 2)) + shapes_uniform(rng, -reach, reach);
    }
  }
  out->motion.points = out->points;
  out->motion.times = out->times;
  for (size_t j = 0; j < joints; j++) {
    const nsvcd_joint *joint = &r->joints[j];
    out->joints[j].slides = joint->kind == NSVCD_JOINT_PRISMATIC;
    out->joints[j].parent = joint->parent;
    memcpy(out->joints[j].origin, joint->origin.position, 7 * sizeof(float));
    memcpy(out->joints[j].axis, joint->axis, 3 * sizeof(float));
  }
  out->checked.joints = out->joints;
  out->checked.joint_count = joints;
  out->checked.pieces = out->motion.pieces;
  out->checked.degree = out->motion.degree;
  out->checked.points = out->points;
  out->checked.times = out->times;
  CHECK(!nsvcd_verify_motion_check(&out->checked));
}

static void cert_part(const robot *r, const cert_motion *m, size_t part, uint32_t base,
                      nsvcd_verify_part *out) {
  out->motion = &m->checked;
  out->link = r->parts[part].link;
  out->base = base;
  memcpy(out->pose, r->parts[part].pose.position, sizeof out->pose);
}

static void certificates_know_joints(void) {
  static robot r;
  shapes_rng rng = {6};
  double tightest = 0;
  cert_body *any = &cert_bodies()[0];
  for (int trial = 0; trial < 1500; trial++) {
    cert_motion m;
    nsvcd_verify_part part;
    nsvcd_verify_mover mover;
    double at[9][3], q[NSVCD_MAX_JOINTS];
    memset(&mover, 0, sizeof mover);
    robot_random(&r, &rng);
    cert_random_motion(&r, &rng, 0.5, &m);
    const size_t n = (size_t)shapes_pick(&rng, (int)r.scene.part_count);
    cert_part(&r, &m, n, 0, &part);
    CHECK(!nsvcd_verify_part_init(&any->checked, (float)scale_of_part(&r.parts[n]), &part, &mover));
    const double t0 = shapes_uniform(&rng, 0, 0.999);
    const double t1 = t0 + (mover.next(&part, t0) - t0) * shapes_uniform(&rng, 0.05, 1);
    const double x[3] = {shapes_uniform(&rng, -0.3, 0.3), shapes_uniform(&rng, -0.3, 0.3), 0.1};
    for (int k = 0; k < 9; k++) {
      const double whole = m.times[m.motion.pieces] - m.times[0];
      const double time = m.times[0] + whole * (t0 + (t1 - t0) * k / 8);
      nsvcd_motion_at(&m.motion, r.scene.joint_count, time, q);
      const placed where = placed_part(&r.scene, n, q);
      placed_point(&where, mover.scale, x, at[k]);
    }
    cert_law_holds(&mover, t0, t1, x, (const double(*)[3])at, 9, &tightest);
  }
  CHECK_GE(tightest, 0.5);
}

// What may move within a part's bound does so at all times, seen from the world and from links that
// carry it; of points as far from the part's origin as is said.
static void certificates_know_what_stays(void) {
  static robot r;
  shapes_rng rng = {16};
  double tightest = 0;
  for (int k = 0; k < 3; k++) {  // the farthest corner, whichever it is
    const uint32_t corners[3] = {0, 1, 2};
    float at[9] = {0.1f, 0, 0, 0, 0.1f, 0, 0, 0, 0.1f};
    uint32_t memory[NSVCD_VERIFY_MESH_BYTES(3, 1) / 4 + 1];
    nsvcd_verify_mesh mesh;
    at[4 * k] = -2;
    CHECK(!nsvcd_verify_mesh_init(at, 3, corners, 1, memory, &mesh));
    CHECK_NEAR(nsvcd_verify_radius(&mesh), 2, 1e-12);
  }
  for (int trial = 0; trial < 1500; trial++) {
    cert_motion m;
    nsvcd_verify_part part;
    nsvcd_verify_place was, is;
    robot_random(&r, &rng);
    cert_random_motion(&r, &rng, trial % 2 ? 0.5 : 0.05, &m);
    const size_t n = (size_t)shapes_pick(&rng, (int)r.scene.part_count);
    uint32_t base = r.parts[n].link;
    for (int up = shapes_pick(&rng, 4); up >= 0 && base > 0; up--) base = r.joints[base - 1].parent;
    cert_part(&r, &m, n, base, &part);
    const size_t from = (size_t)shapes_pick(&rng, (int)m.motion.pieces);
    const size_t to = from + 1 + (size_t)shapes_pick(&rng, (int)(m.motion.pieces - from));
    const size_t there = trial % 3 ? from : to;
    const double whole = m.times[m.motion.pieces] - m.times[0];
    const double ends[2] = {(m.times[from] - m.times[0]) / whole,
                            (m.times[to] - m.times[0]) / whole};
    const double radius = trial % 5 ? shapes_uniform(&rng, 0, 0.5) : 0;
    double moved = 0;
    verify__part_place(&part, ends[there == to], &was);
    for (int k = 0; k <= 40; k++) {
      double x[3], off[3];
      verify__part_place(&part, ends[0] + (ends[1] - ends[0]) * k / 40, &is);
      shapes_direction(&rng, x);
      for (int i = 0; i < 3; i++) {
        off[i] = is.at[i] - was.at[i];
        for (int j = 0; j < 3; j++)
          off[i] += radius * x[j] * (is.turn[3 * i + j] - was.turn[3 * i + j]);
      }
      moved = fmax(moved, oracle_length(off));
    }
    // more than it moves it is said to stay within, and not much more, where it is one joint that moves
    if (moved > 1e-9)
      CHECK(!nsvcd_verify_stays(&part, radius, from, to, there, moved * (1 - 1e-9)));
    CHECK(nsvcd_verify_stays(&part, radius, from, to, there, 1e9));
    for (double f = 1; f > tightest; f *= 0.98)
      if (nsvcd_verify_stays(&part, radius, from, to, there, moved / f)) tightest = f;
  }
  CHECK_GE(tightest, 0.9);
}

// Trees of the robots' shapes, as cert_bodies has them.
static cert_body *cert_robot_shapes(void) {
  static cert_body made[SHAPES];
  if (made[0].body) return made;
  for (int n = 0; n < SHAPES; n++) {
    const robot_shape *shape = &robot_shapes()[n];
    shapes_mesh m;
    memset(&m, 0, sizeof m);
    for (size_t i = 0; i < shape->exact.triangle_count; i++) {
      uint32_t corner[3];
      for (int k = 0; k < 3; k++) {
        const double *v = shape->exact.triangles[i].v[k];
        corner[k] = shapes_vertex(&m, v[0], v[1], v[2]);
      }
      shapes_triangle(&m, corner[0], corner[1], corner[2]);
    }
    cert_make(&m, &made[n]);
  }
  return made;
}

// Two corners of two parts come nearer to each other, in a box of joint values and from its middle, by
// no more than is said of the parts; and what the checker says of them the library, whose certificates
// it is for, says as well, or more.
static void certificates_know_boxes(void) {
  static robot r;
  shapes_rng rng = {18};
  cert_body *shapes = cert_robot_shapes();
  double tightest = 0;
  for (int trial = 0; trial < 3000; trial++) {
    cert_motion m;
    nsvcd_verify_part parts[2];
    const nsvcd_verify_mesh *meshes[2];
    const double *corners[2];
    double low[NSVCD_MAX_JOINTS], high[NSVCD_MAX_JOINTS], half[NSVCD_MAX_JOINTS];
    double moved[NSVCD_MAX_JOINTS], points[2 * NSVCD_MAX_JOINTS];
    do robot_random(&r, &rng);
    while (r.scene.part_count < 2);
    const size_t joints = r.scene.joint_count;
    for (size_t n = 0; n < r.scene.part_count; n++) r.parts[n].scale = 0;
    const int last = (int)r.scene.part_count - 1;
    nsvcd_body_pair two = {(uint32_t)shapes_pick(&rng, last), (uint32_t)last};
    const nsvcd_body_pair *pair = &two;
    robot_open(&r);
    cert_random_motion(&r, &rng, 0.1, &m);
    const double wide = trial % 3 ? 1.5 : 0.2;
    for (size_t j = 0; j < joints; j++) {
      const double middle = shapes_uniform(&rng, -2, 2);
      half[j] = shapes_pick(&rng, 3) ? shapes_uniform(&rng, 0, wide) : 0;
      low[j] = points[j] = points[joints + j] = middle;
      low[j] -= half[j];
      high[j] = middle + half[j];
      half[j] *= 1 + 1e-12;
    }
    const uint32_t but = trial % 2 ? 1 + (uint32_t)shapes_pick(&rng, (int)joints) : 0;
    if (but) points[but - 1] = low[but - 1];
    if (but) points[joints + but - 1] = high[but - 1];
    m.checked.pieces = m.checked.degree = 1;
    m.checked.points = points;
    for (int n = 0; n < 2; n++) {
      const size_t part = n ? pair->b : pair->a;
      const oracle_mesh *exact = &robot_shapes()[r.shape[part]].exact;
      cert_part(&r, &m, part,
                nsvcd_verify_common(&m.checked, r.parts[pair->a].link, r.parts[pair->b].link),
                &parts[n]);
      meshes[n] = &shapes[r.shape[part]].checked;
      corners[n] = exact->triangles[shapes_pick(&rng, (int)exact->triangle_count)].v[trial % 3];
    }
    const double travel = nsvcd_verify_travel(parts, meshes, half, but);
    double told = 0;
    CHECK_EQ(nsvcd_pair_travel(r.checker, *pair, low, high, moved), NSVCD_OK);
    for (size_t j = 0; j < joints; j++) told += j + 1 == but ? 0 : moved[j];
    CHECK_LE(travel, told * (1 + 1e-9) + 1e-12);
    for (int k = 0; k < 60; k++) {
      double q[2][NSVCD_MAX_JOINTS], off[2][3], x[2][3];
      for (size_t j = 0; j < joints; j++) {
        q[0][j] = 0.5 * (low[j] + high[j]);
        q[1][j] = k % 4                  ? shapes_uniform(&rng, low[j], high[j])
                  : shapes_pick(&rng, 2) ? low[j]
                                         : high[j];
        if (j + 1 == but) q[0][j] = q[1][j];
      }
      for (int at = 0; at < 2; at++) {
        for (int n = 0; n < 2; n++) {
          const placed where = placed_part(&r.scene, n ? pair->b : pair->a, q[at]);
          placed_point(&where, 1, corners[n], x[n]);
        }
        oracle_sub(x[0], x[1], off[at]);
      }
      const double nearer = fabs(oracle_length(off[0]) - oracle_length(off[1]));
      CHECK_LE(nearer, travel + 1e-12);
      if (travel > 1e-6) tightest = fmax(tightest, nearer / travel);
    }
    free(r.memory);
  }
  CHECK_GE(tightest, 0.95);
}

// A robot that is open, a motion of it, and its pairs, certified and checked: what is certified
// free is so at many times, as the oracle places links; and a certificate of another motion is
// refused.
static void certificates_of_robots(void) {
  static robot r;
  static uint8_t bytes[CERT_ROOM];
  shapes_rng rng = {7};
  cert_body *shapes = cert_robot_shapes();
  size_t free_pairs = 0;
  size_t hits = 0;
  for (int trial = 0; trial < (int)check_many(10); trial++) {
    cert_motion m, other;
    robot_arm(&r, &rng, 5);
    cert_random_motion(&r, &rng, trial % 3 ? 0.3 : 1, &m);
    cert_random_motion(&r, &rng, 0.3, &other);
    const float clearance = trial % 2 ? 0.01f : 0;
    for (size_t n = 0; n < r.scene.pair_count; n += 3) {
      const nsvcd_body_pair *pair = &r.pairs[n];
      const cert_body *a = &shapes[r.shape[pair->a]];
      const cert_body *b = &shapes[r.shape[pair->b]];
      nsvcd_certificate made;
      nsvcd_verify_part parts[2];
      nsvcd_verify_mover movers[2];
      nsvcd_verify_report report;
      uint64_t memory[8192];
      memset(movers, 0, sizeof movers);
      const nsvcd_certify_options options = {NULL, 20000};
      const size_t size = nsvcd_certify_pair_workspace_size(&m.motion, a->tree, b->tree);
      CHECK_LE(size, sizeof memory);
      CHECK_EQ(nsvcd_certify_pair(r.checker, &m.motion, n, clearance, a->tree, b->tree, &options,
                                  memory, sizeof memory, bytes, sizeof bytes, &made),
               NSVCD_OK);
      if (made.verdict == NSVCD_UNDECIDED) continue;
      const uint32_t base =
          nsvcd_verify_common(&m.checked, r.parts[pair->a].link, r.parts[pair->b].link);
      for (int k = 0; k < 2; k++) {
        const size_t part = k ? pair->b : pair->a;
        cert_part(&r, &m, part, base, &parts[k]);
        CHECK(!nsvcd_verify_part_init(k ? &b->checked : &a->checked,
                                      (float)scale_of_part(&r.parts[part]), &parts[k], &movers[k]));
      }
      CHECK(nsvcd_verify(&movers[0], &movers[1], clearance, bytes, made.size, memory, sizeof memory,
                         &report));
      if (made.verdict == NSVCD_HIT) hits++;
      double least = 1;
      for (int k = 0; k <= 40; k++) {
        double q[NSVCD_MAX_JOINTS];
        const double whole = m.times[m.motion.pieces] - m.times[0];
        const double t = report.kind == NSVCD_VERIFY_FREE ? k / 40.0 : report.time;
        nsvcd_motion_at(&m.motion, r.scene.joint_count, m.times[0] + whole * t, q);
        least = fmin(least, robot_apart(&r, pair, q, 1));
      }
      if (made.verdict == NSVCD_FREE) {
        free_pairs++;
        CHECK_GE(least, (double)clearance);
      } else {
        CHECK_LE(least, (double)clearance + 1e-6);
      }
      parts[0].motion = parts[1].motion = &other.checked;
      for (int k = 0; k < 2; k++)
        CHECK(
            !nsvcd_verify_part_init(movers[k].mesh, (float)movers[k].scale, &parts[k], &movers[k]));
      CHECK(!nsvcd_verify(&movers[0], &movers[1], clearance, bytes, made.size, memory,
                          sizeof memory, &report));
    }
    free(r.memory);
  }
  CHECK_GE(free_pairs, check_many(40));
  CHECK_GE(hits, 1);
}

// ---- levels

// A body that goes over a floor of 200,000 triangles takes no more than three times the bytes that
// it takes over the piece that it can reach.
static void certificates_of_levels(void) {
  enum { SIDE = 317 };
  shapes_rng rng = {8};
  shapes_mesh floor_shape;
  cert_body level, piece;
  memset(&floor_shape, 0, sizeof floor_shape);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      shapes_vertex(&floor_shape, 0.05 * x, 0.05 * y, 0.1 * sin(0.3 * x) * cos(0.4 * y));
  for (uint32_t i = 0; i + SIDE < SIDE * SIDE; i++)
    if (i % SIDE + 1 < SIDE) shapes_quad(&floor_shape, i, i + 1, i + SIDE + 1, i + SIDE);
  cert_make(&floor_shape, &level);
  CHECK_GE(level.mesh.triangle_count, 199000);
  size_t whole = 0;
  size_t local = 0;
  for (int trial = 0; trial < 12; trial++) {
    cert_scene s;
    nsvcd_certificate made;
    static uint8_t bytes[CERT_ROOM];
    nsvcd_mesh part = {NULL, NULL, 0, 0};
    shapes_mesh cut;
    cert_rest(&s, &cert_bodies()[shapes_pick(&rng, 5)], &level);
    cert_random_poses(&rng, s.poses[0], s.times[0], 2, 0.2, 1);
    const float x = (float)shapes_uniform(&rng, 2, 13);
    const float y = (float)shapes_uniform(&rng, 2, 13);
    for (int k = 0; k < 2; k++) {
      s.poses[0][k].position[0] += x;
      s.poses[0][k].position[1] += y;
      s.poses[0][k].position[2] = (float)shapes_uniform(&rng, 0.2, 0.3);
    }
    s.question.a.count = 2;
    CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
    if (made.verdict != NSVCD_FREE) continue;
    whole += made.size;
    const float low[3] = {x - 0.6f, y - 0.6f, -1};
    const float high[3] = {x + 0.6f, y + 0.6f, 1};
    CHECK_EQ(nsvcd_mesh_cut(&level.mesh, low, high, NULL, &part), NSVCD_OK);
    memset(&cut, 0, sizeof cut);
    for (size_t i = 0; i < part.vertex_count; i++) {
      const float *v = part.positions + 3 * i;
      shapes_vertex(&cut, (double)v[0], (double)v[1], (double)v[2]);
    }
    for (size_t t = 0; t < part.triangle_count; t++)
      shapes_triangle(&cut, part.indices[3 * t], part.indices[3 * t + 1], part.indices[3 * t + 2]);
    cert_make(&cut, &piece);
    s.b = &piece;
    CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
    CHECK_EQ(made.verdict, NSVCD_FREE);
    local += made.size;
    nsvcd_mesh_free(&part, NULL);
    cert_free(&piece);
  }
  cert_free(&level);
  CHECK_GE(local, 100);
  CHECK_LE(whole, 3 * local);
}

// A fine body turns on its way along a large floor, near it: its small nodes move far, however large
// the floor is.
static void certificates_of_what_is_fine_over_a_floor(void) {
  cert_body fine, ground;
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_ellipsoid(&shape, 0.15, 0.06, 0.04, 80);
  cert_make(&shape, &fine);
  CHECK_GE(fine.mesh.triangle_count, 6000);
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 4, 4, 0.02, 1);
  cert_make(&shape, &ground);
  for (int n = 0; n < 4; n++) {
    static uint8_t bytes[CERT_ROOM];
    const float lean[4][4] = {{0.3f, 0.1f, 0.2f, 0.9273618f},
                              {0.1f, -0.4f, 0.3f, 0.8602325f},
                              {-0.2f, 0.5f, -0.1f, 0.8366600f},
                              {0, 0.6f, 0.2f, 0.7745967f}};
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    cert_rest(&s, &fine, &ground);
    s.question.a.count = 2;
    memset(&made, 0, sizeof made);
    for (float z = 0.05f; z < 0.2f && made.verdict != NSVCD_FREE; z += 1e-3f) {
      for (int k = 0; k < 2; k++) {
        nsvcd_pose *pose = &s.poses[0][k];
        memcpy(pose->rotation, lean[(n + k) % 4], sizeof pose->rotation);
        pose->position[0] = k ? 0.6f : -0.7f;
        pose->position[2] = z;
      }
      CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
      if (made.verdict == NSVCD_UNDECIDED) break;
    }
    CHECK_EQ(made.verdict, NSVCD_FREE);
    CHECK_LE(made.visits, 600);
    cert_look(&s, &view);
    CHECK(cert_check(&view, 0, bytes, made.size, &report));
  }
  cert_free(&fine);
  cert_free(&ground);
}

// Boxes and prisms that are set down flat on others, and into them: at the first contact faces lie on faces, and no edge
// passes through a triangle until later. With that answer, with any, and with none the hit is proven.
static void certificates_of_what_is_set_down(void) {
  shapes_rng rng = {52};
  cert_body ground, thing;
  shapes_mesh shape;
  memset(&shape, 0, sizeof shape);
  shapes_box(&shape, 1, 1, 0.5, 3);
  cert_make(&shape, &ground);
  for (int n = 0; n < 85; n++) {  // the last is found at an instant only
    static uint8_t bytes[CERT_ROOM];
    static uint64_t memory[65536];
    cert_scene s;
    cert_view view;
    nsvcd_answer answers[3];  // the last: nothing was decided
    memset(answers, 0, sizeof answers);
    answers[2].time.high = HUGE_VALF;
    const double height = shapes_uniform(&rng, 0.05, 0.3);
    const double into = shapes_uniform(&rng, 0.005, 0.1);
    memset(&shape, 0, sizeof shape);
    if (n % 2)
      shapes_box(&shape, 0.2, 0.3, height, 1 + n % 4);
    else
      shapes_cylinder(&shape, 0.1, height, 5 + n % 9);
    cert_make(&shape, &thing);
    cert_rest(&s, &thing, &ground);
    s.question.a.body = thing.body;
    s.question.b.body = ground.body;
    s.question.a.count = 2;
    const double top = 0.25 + height / 2;
    for (int k = 0; k < 2; k++) {
      float *at = s.poses[0][k].position;
      at[0] = at[1] = (float)shapes_uniform(&rng, -0.2, 0.2);
      at[2] = (float)(k ? top - into : top + shapes_uniform(&rng, 0.1, 2));
    }
    for (int ask = 0; ask < 2; ask++) {
      s.question.ask = ask ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
      CHECK_EQ(nsvcd_sweep(&s.question, memory, sizeof memory, &answers[ask]), NSVCD_OK);
      CHECK_EQ(answers[ask].verdict, NSVCD_HIT);
    }
    s.question.ask = NSVCD_ASK_HIT;
    cert_look(&s, &view);
    for (int told = 0; told < 4; told++) {
      nsvcd_certificate made;
      nsvcd_verify_report report;
      const nsvcd_answer *answer = told < 3 ? &answers[told] : NULL;
      CHECK_EQ(cert_certify(&s, answer, bytes, sizeof bytes, &made), NSVCD_OK);
      CHECK_EQ(made.verdict, NSVCD_HIT);
      CHECK_LE(made.visits, told < 2 ? 30000 : 130000);
      CHECK(cert_check(&view, 0, bytes, made.size, &report));
    }
    cert_free(&thing);
  }
  cert_free(&ground);
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// Faces on faces: a rounding of float apart they are proven free, and nearer never.
static void certificates_at_a_hair(void) {
  cert_body *box = &cert_bodies()[0];
  static uint8_t bytes[CERT_ROOM];
  for (int n = -3; n <= 3; n++) {
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    cert_rest(&s, box, box);
    s.question.a.count = 2;
    // 2 * 0.1f as the mesh has it
    float up = 2 * box->mesh.positions[0];
    up = up < 0 ? -up : up;
    for (int k = 0; k < (n < 0 ? -n : n); k++) up = nextafterf(up, n < 0 ? 0.0f : 1.0f);
    s.poses[0][0].position[2] = s.poses[0][1].position[2] = up;
    s.poses[0][0].position[0] = -0.05f;
    s.poses[0][1].position[0] = 0.07f;
    CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
    CHECK_EQ(made.verdict == NSVCD_FREE, n > 0);
    cert_look(&s, &view);
    if (n > 0) CHECK(cert_check(&view, 0, bytes, made.size, &report));
    uint8_t plane[64];
    const size_t of_plane = cert_one_plane(&s, bytes, nsvcd__d3_of(0, 0, 1), plane);
    CHECK_EQ(cert_check(&view, 0, plane, of_plane, &report), n > 0);
    if (n > 0) continue;
    // what proves the free one proves nothing here
    cert_scene apart = s;
    nsvcd_certificate of_apart;
    uint8_t head[CERT_ROOM];
    cert_own(&apart);
    for (int k = 0; k < 2; k++) apart.poses[0][k].position[2] = nextafterf(0.2f, 1);
    CHECK_EQ(cert_certify(&apart, NULL, head, sizeof head, &of_apart), NSVCD_OK);
    CHECK_EQ(of_apart.verdict, NSVCD_FREE);
    cert_forge(head, (const uint8_t *)bytes);
    CHECK(!cert_check(&view, 0, head, of_apart.size, &report));
  }
}

// A box turns by a quarter over another one, and is lifted, or let down: both ends are above it, the
// corners in between are not. Then the one below turns, as seen from the one above.
static void certificates_see_a_swing(void) {
  for (int n = 0; n < 4; n++) {
    const int back = n % 2;
    const int below = n / 2;
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    uint8_t head[CERT_ROOM], bytes[64];
    cert_rest(&s, &cert_bodies()[0], &cert_bodies()[0]);
    (below ? &s.question.b : &s.question.a)->count = 2;
    const float half = 0.70710678f;
    for (int k = 0; k < 2; k++) {
      nsvcd_pose *pose = &s.poses[below][k];
      const int turned = k != back;
      pose->rotation[1] = turned ? half : 0;
      pose->rotation[3] = turned ? half : 1;
      pose->position[2] = (below ? -1.0f : 1.0f) * (turned ? 0.27f : 0.205f);
    }
    CHECK_EQ(cert_certify(&s, NULL, head, sizeof head, &made), NSVCD_OK);
    CHECK_EQ(made.verdict, NSVCD_HIT);
    cert_look(&s, &view);
    const size_t size = cert_one_plane(&s, head, nsvcd__d3_of(0, 0, 1), bytes);
    CHECK(!cert_check(&view, 0, bytes, size, &report));
    CHECK_EQ(report.kind, NSVCD_VERIFY_NOTHING);
    // without the turn it is what it says
    for (int k = 0; k < 2; k++) {
      s.poses[below][k].rotation[1] = 0;
      s.poses[below][k].rotation[3] = 1;
    }
    CHECK_EQ(cert_certify(&s, NULL, head, sizeof head, &made), NSVCD_OK);
    cert_look(&s, &view);
    cert_forge(bytes, head);
    CHECK(cert_check(&view, 0, bytes, size, &report));
    // but not to a clearance that there is not: 5 mm
    s.question.clearance = 0.0051f;
    CHECK_EQ(cert_certify(&s, NULL, head, sizeof head, &made), NSVCD_OK);
    CHECK_EQ(made.verdict, NSVCD_HIT);
    cert_look(&s, &view);
    cert_forge(bytes, head);
    CHECK(!cert_check(&view, s.question.clearance, bytes, size, &report));
  }
}

// What is computed from lengths that cancel is no better than these: a body of 50 um that goes from
// one end of the world to the other passes another one by 10 um, which nobody can tell, or by 10 mm.
// And what is tiny is not taken for a point.
static void certificates_of_lengths_that_cancel(void) {
  for (int n = 0; n < 2; n++) {
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    uint8_t head[CERT_ROOM], bytes[64];
    cert_rest(&s, &cert_bodies()[9], &cert_bodies()[9]);
    s.question.a.count = 2;
    s.question.a.scale = s.question.b.scale = 1e-3f;
    for (int k = 0; k < 2; k++) {
      s.poses[0][k].position[0] = k ? 9e5f : -9e5f;
      s.poses[0][k].position[2] = 5e-5f + (n ? 1e-2f : 1e-5f);
    }
    CHECK_EQ(cert_certify(&s, NULL, head, sizeof head, &made), NSVCD_OK);
    CHECK_EQ(made.verdict, n ? NSVCD_FREE : NSVCD_UNDECIDED);
    cert_look(&s, &view);
    const size_t size = cert_one_plane(&s, head, nsvcd__d3_of(0, 0, 1), bytes);
    CHECK_EQ(cert_check(&view, 0, bytes, size, &report), n);
    uint8_t pass[CERT_ROOM];
    nsvcd__certifier c = cert_writer(&s, NSVCD__PROVES_FREE, pass, sizeof pass);
    cert_write_pass(&c, 0, 1, 1000);
    cert_forge(pass, head);
    CHECK_EQ(cert_check(&view, 0, pass, (c.bits + 7) / 8, &report), n);
  }
  for (double size = 1e-35; size < 1e6; size *= 10) {
    const float corners[9] = {(float)size, 0, 0, 0, (float)size, 0, 0, 0, (float)size};
    const uint32_t indices[3] = {0, 1, 2};
    uint32_t memory[64];
    nsvcd_verify_mesh mesh;
    nsvcd_verify_mover mover;
    memset(&mesh, 0, sizeof mesh);
    memset(&mover, 0, sizeof mover);
    const float pose[7] = {0, 0, 0, 0, 0, 0, 1};
    const nsvcd_verify_path path = {pose, NULL, 1};
    const nsvcd_verify_node root = {0, 0, 1};
    CHECK_LE(NSVCD_VERIFY_MESH_BYTES(3, 1), sizeof memory);
    CHECK(!nsvcd_verify_mesh_init(corners, 3, indices, 1, memory, &mesh));
    CHECK(!nsvcd_verify_path_init(&mesh, 1, &path, &mover));
    CHECK_GE(verify__radius(&mover, &root), size * 1.7);
  }
}

// Lone triangles, of which each corner in turn sticks into a box.
static void certificates_of_each_corner(void) {
  for (int corner = 0; corner < 3; corner++) {
    shapes_mesh shape;
    cert_body lone;
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    uint8_t head[CERT_ROOM], bytes[64];
    memset(&shape, 0, sizeof shape);
    for (int k = 0; k < 3; k++)
      shapes_vertex(&shape, k == 1 ? 0.02 : 0, k == 2 ? 0.02 : 0, k == corner ? -0.03 : 0);
    shapes_triangle(&shape, 0, 1, 2);
    cert_make(&shape, &lone);
    cert_rest(&s, &lone, &cert_bodies()[0]);
    s.poses[0][0].position[2] = 0.12f;
    CHECK_EQ(cert_certify(&s, NULL, head, sizeof head, &made), NSVCD_OK);
    CHECK_EQ(made.verdict, NSVCD_HIT);
    cert_look(&s, &view);
    const size_t size = cert_one_plane(&s, head, nsvcd__d3_of(0, 0, 1), bytes);
    CHECK(!cert_check(&view, 0, bytes, size, &report));
    cert_free(&lone);
  }
}

// Of what is free, at clearances a little less than it keeps, nobody can show that it meets, comes
// near or is inside: whatever triangles, times, edges, points, corners and rays are named. And what
// does is not shown by a certificate that is cut short.
static void certificates_of_hits_cannot_be_forged(void) {
  static uint8_t bytes[CERT_ROOM], honest[CERT_ROOM];
  shapes_rng rng = {11};
  size_t scenes = 0;
  size_t cut = 0;
  for (int trial = 0; trial < 2000 && scenes < 100; trial++) {
    cert_scene s;
    cert_view view;
    nsvcd_certificate made;
    nsvcd_verify_report report;
    int inside;
    cert_random(&s, &rng);
    // a small box in an open one, some times
    if (trial % 8 == 0) {
      s.a = &cert_bodies()[9];
      s.b = &cert_bodies()[CERT_SHAPES - 1];
      for (int k = 0; k < CERT_POSES; k++)
        for (int i = 0; i < 3; i++) s.poses[0][k].position[i] = s.poses[1][k].position[i] = 0;
      s.question.a.scale = 0.3f;
      s.question.b.scale = s.question.clearance = 0;
    }
    CHECK_EQ(cert_certify(&s, NULL, honest, sizeof honest, &made), NSVCD_OK);
    cert_look(&s, &view);
    if (made.verdict == NSVCD_HIT && cut < 60) {
      cut++;
      for (size_t size = 0; size < made.size; size++)
        CHECK(!cert_check(&view, s.question.clearance, honest, size, &report));
      memcpy(bytes, honest, made.size);
      bytes[made.size] = 0;
      CHECK(!cert_check(&view, s.question.clearance, bytes, made.size + 1, &report));
      // as near as they are at those points, less 10 um, they are not
      CHECK(cert_check(&view, s.question.clearance, honest, made.size, &report));
      const double apart = cert_apart(&s, report.time, 1, NULL);
      if (report.kind == NSVCD_VERIFY_NEAR && apart > 2e-5) {
        s.question.clearance = (float)(apart - 1e-5);
        CHECK_EQ(cert_certify(&s, NULL, bytes, sizeof bytes, &made), NSVCD_OK);
        cert_look(&s, &view);
        cert_forge(honest, bytes);
        CHECK(!cert_check(&view, s.question.clearance, honest, 25, &report));
        continue;
      }
    }
    if (made.verdict != NSVCD_FREE) continue;
    const double least = cert_least(&s, 1, &inside);
    if (least > 0.1) continue;
    scenes++;
    // as much as the oracle's times can tell, and more than nothing
    s.question.clearance = (float)fmax((double)s.question.clearance, 0.98 * least - 0.001);
    cert_look(&s, &view);
    if (cert_certify(&s, NULL, honest, sizeof honest, &made) || made.verdict != NSVCD_FREE)
      continue;
    for (int n = 0; n < 3000; n++) {
      const int kind = NSVCD__PROVES_HIT + n % 3;
      nsvcd__certifier c = cert_writer(&s, kind, bytes, sizeof bytes);
      nsvcd__write_bits(&c, (uint32_t)(shapes_uniform(&rng, 0, 1) * 4294967295.0), 32);
      if (kind == NSVCD__PROVES_INSIDE) {
        const int of_b = shapes_pick(&rng, 2);
        const cert_body *of = of_b ? s.b : s.a;
        nsvcd__write_bits(&c, (uint32_t)of_b, 1);
        nsvcd__write_bits(&c, (uint32_t)shapes_pick(&rng, (int)of->mesh.vertex_count), 32);
        nsvcd__write_bits(&c, 0, 8);
      } else {
        nsvcd__write_bits(&c, (uint32_t)shapes_pick(&rng, (int)s.a->mesh.triangle_count), 32);
        nsvcd__write_bits(&c, (uint32_t)shapes_pick(&rng, (int)s.b->mesh.triangle_count), 32);
      }
      if (kind == NSVCD__PROVES_HIT) nsvcd__write_bits(&c, (uint32_t)shapes_pick(&rng, 8), 3);
      for (int k = 0; k < 4 && kind == NSVCD__PROVES_NEAR; k++)
        nsvcd__write_bits(&c, (uint32_t)shapes_pick(&rng, 65536), 16);
      if (kind == NSVCD__PROVES_INSIDE)
        nsvcd__write_bits(&c, (uint32_t)shapes_pick(&rng, 65536), 16);
      const size_t size = (c.bits + 7) / 8;
      cert_forge(bytes, honest);
      CHECK(!cert_check(&view, s.question.clearance, bytes, size, &report));
    }
  }
  CHECK_GE(scenes, 100);
  CHECK_GE(cut, 60);
}

// The walk that a scene's surfaces are apart is one thing, that nothing is inside another: the walk
// of a small body in a solid, which is honest, and rays that are not.
static void certificates_need_rays(void) {
  nsvcd__certifier c;
  static uint8_t bytes[CERT_ROOM];
  nsvcd__instant instants[8];
  nsvcd_mover movers[2];
  nsvcd_certificate made;
  nsvcd_verify_report report;
  cert_scene s;
  cert_view view;
  cert_rest(&s, &cert_bodies()[9], &cert_bodies()[0]);
  memset(&c, 0, sizeof c);
  memset(&made, 0, sizeof made);
  c.bodies[0].tree = s.a->tree;
  c.bodies[1].tree = s.b->tree;
  CHECK_EQ(nsvcd__model_of(&s.question.a, &movers[0], &c.bodies[0].model), NSVCD_OK);
  CHECK_EQ(nsvcd__model_of(&s.question.b, &movers[1], &c.bodies[1].model), NSVCD_OK);
  const float clearance = 0;
  c.interval.bodies = c.bodies;
  c.interval.instants = instants;
  c.interval.capacity = 8;
  c.bytes = bytes;
  c.capacity = sizeof bytes;
  c.digest = nsvcd__digest(c.bodies[0].model.digest + 31 * c.bodies[1].model.digest, &clearance, 1);
  c.made = &made;
  CHECK_EQ(nsvcd__prove_traversal(&c, 0, 1, 100000), NSVCD_FREE);
  CHECK(!c.separated);
  const size_t bits = c.bits;
  cert_look(&s, &view);
  for (int n = 0; n < 500; n++) {
    shapes_rng rng = {(uint64_t)n + 1};
    c.bits = bits;
    for (int k = 0; k < 2; k++) {
      const nsvcd__d3 along =
          nsvcd__d3_of(shapes_uniform(&rng, -1, 1), shapes_uniform(&rng, -1, 1), 0.5);
      const nsvcd__coded_normal ray = nsvcd__normal_of(along, 8);
      nsvcd__write_bits(&c, 0, 1);
      nsvcd__write_normal(&c, NSVCD__REMEMBERED, &ray);
    }
    CHECK(!cert_check(&view, 0, bytes, (c.bits + 7) / 8, &report));
    CHECK(report.reason && (strstr(report.reason, "ray") != NULL));
  }
}

void test_certificate(void) {
  RUN(certificates_are_true);
  RUN(certificates_cannot_be_forged);
  RUN(certificates_of_half_turns);
  RUN(certificates_of_answers_that_lie);
  RUN(certificates_of_what_is_inside);
  RUN(certificates_of_other_scenes);
  RUN(certificates_refuse);
  RUN(certificates_know_paths);
  RUN(certificates_know_joints);
  RUN(certificates_know_what_stays);
  RUN(certificates_know_boxes);
  RUN(certificates_of_robots);
  RUN(certificates_of_levels);
  RUN(certificates_of_what_is_fine_over_a_floor);
  RUN(certificates_of_what_is_set_down);
  // from within
  RUN(certificates_at_a_hair);
  RUN(certificates_see_a_swing);
  RUN(certificates_of_lengths_that_cancel);
  RUN(certificates_of_each_corner);
  RUN(certificates_of_hits_cannot_be_forged);
  RUN(certificates_need_rays);
}
CHECK_ALONE(test_certificate)
