// The checker of certificates alone, without the library: what it must refuse, whatever bytes come
// to it, in builds and threads that do not calculate as IEEE 754 has it too. Certificates are made
// here, by hand. test_certificate.c has those that the library makes.
#include "../examples/verify/nsvcd_verify_robot.h"
#include "check.h"

#include <fenv.h>
#if defined(__SSE2__) && (defined(__GNUC__) || defined(__clang__))
#include <xmmintrin.h>
#define HAS_SUBNORMAL_SWITCH 1
#endif

void test_checker(void);

// ---- scenes: tetrahedra along paths

#define ROOM 2048  // bytes of a certificate

// Corners at the origin and `size` along each axis, and, where there is one, a vertex of no triangle.
typedef struct tetrahedron {
  float positions[15];
  uint32_t indices[12];
  uint64_t memory[64];
  nsvcd_verify_mesh mesh;
} tetrahedron;

static const char *tetrahedron_of(float size, const float *stray_vertex, int stray_first,
                                  tetrahedron *out) {
  static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const uint32_t first = stray_vertex && stray_first;
  memset(out, 0, sizeof *out);
  for (uint32_t k = 0; k < 3; k++) out->positions[3 * (first + 1 + k) + k] = size;
  if (stray_vertex)
    memcpy(out->positions + (stray_first ? 0 : 12), stray_vertex, 3 * sizeof(float));
  for (int i = 0; i < 12; i++) out->indices[i] = faces[i] + first;
  CHECK_LE(NSVCD_VERIFY_MESH_BYTES(5, 4), sizeof out->memory);
  return nsvcd_verify_mesh_init(out->positions, stray_vertex ? 5 : 4, out->indices, 4, out->memory,
                                &out->mesh);
}

typedef struct scene {
  tetrahedron a, b;
  float poses[2][21];  // x y z, quaternion x y z w
  float times[2][3];
  nsvcd_verify_path paths[2];
  nsvcd_verify_mover movers[2];
} scene;

// Two of size 1 at rest, b with its corner so far along x.
static void scene_of(float apart, scene *s) {
  memset(s, 0, sizeof *s);
  CHECK(!tetrahedron_of(1, NULL, 0, &s->a));
  CHECK(!tetrahedron_of(1, NULL, 0, &s->b));
  for (int n = 0; n < 2; n++) {
    for (int k = 0; k < 3; k++) {
      s->poses[n][7 * k + 6] = 1;
      if (n == 1) s->poses[n][7 * k] = apart;
      s->times[n][k] = 0.5f * (float)k;
    }
    s->paths[n].poses = s->poses[n];
    s->paths[n].count = 1;
  }
}
static const char *scene_init(scene *s) {
  const char *why = nsvcd_verify_path_init(&s->a.mesh, 1, &s->paths[0], &s->movers[0]);
  return why ? why : nsvcd_verify_path_init(&s->b.mesh, 1, &s->paths[1], &s->movers[1]);
}

// ---- certificates

typedef struct writer {
  uint8_t bytes[ROOM];
  size_t bits;
} writer;

static void put(writer *w, uint32_t value, int count) {
  for (; count > 0 && w->bits < 8 * ROOM; count--, w->bits++)
    if (value >> (count - 1) & 1) w->bytes[w->bits / 8] |= (uint8_t)(0x80 >> w->bits % 8);
}

// The head of a certificate about two movers: digests are no secret.
static void begin(writer *w, const nsvcd_verify_mover *movers, float clearance, int kind) {
  const uint32_t motion = verify__hash(movers[0].digest + 31 * movers[1].digest, &clearance, 1);
  memset(w, 0, sizeof *w);
  put(w, 1, 6);
  put(w, (uint32_t)kind - 1, 2);
  put(w, verify__fold(movers[0].mesh->digest, 8), 8);
  put(w, verify__fold(movers[1].mesh->digest, 8), 8);
  put(w, verify__fold(motion, 16), 16);
}

// A new normal of 8 bits a number; of -1, 0 and 1 along each axis.
static void put_normal(writer *w, int x, int y, int z) {
  const int sum = abs(x) + abs(y) + abs(z);
  int u = 127 * x / sum;
  int v = 127 * y / sum;
  if (z < 0) {
    const int folded = (x < 0 ? -1 : 1) * (127 - abs(v));
    v = (y < 0 ? -1 : 1) * (127 - abs(u));
    u = folded;
  }
  put(w, 0, 8);  // new; of 8 bits
  put(w, (uint32_t)(u + 127), 8);
  put(w, (uint32_t)(v + 127), 8);
}
static void put_plane(writer *w, int x, int y, int z) {
  put(w, 5, 3);
  put_normal(w, x, y, z);
}

static int check_bytes(const nsvcd_verify_mover *movers, float clearance, const writer *w,
                       nsvcd_verify_report *report) {
  static double workspace[NSVCD_VERIFY_WORKSPACE_BYTES(16) / sizeof(double)];
  return nsvcd_verify(&movers[0], &movers[1], clearance, w->bytes, (w->bits + 7) / 8, workspace,
                      sizeof workspace, report);
}

// How far the triangles of a node reach along a direction, metres, of a mover at rest.
static double reach_along(const nsvcd_verify_mover *m, const nsvcd_verify_node *node,
                          const double *n) {
  double most = -1e30;
  for (uint32_t i = 0; i < 3 * node->count; i++) {
    const uint32_t triangle = m->mesh->order[node->first + i / 3];
    const float *x = m->mesh->positions + 3 * m->mesh->indices[3 * triangle + i % 3];
    const float *at = ((const nsvcd_verify_path *)m->motion)->poses;
    double along = 0;
    for (int k = 0; k < 3; k++) along += n[k] * (m->scale * (double)x[k] + (double)at[k]);
    most = fmax(most, along);
  }
  return most;
}

// Writes a walk that holds: planes of 26 directions, or smaller nodes. 0: there is none.
static int put_walk(writer *w, const nsvcd_verify_mover *m, nsvcd_verify_node a,
                    nsvcd_verify_node b) {
  for (int k = 0; k < 27; k++) {
    const int n[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    const double along[3] = {n[0], n[1], n[2]};
    const double back[3] = {-n[0], -n[1], -n[2]};
    if (k == 13 || !(-reach_along(&m[0], &a, back) - reach_along(&m[1], &b, along) > 1e-3))
      continue;
    put_plane(w, n[0], n[1], n[2]);
    return 1;
  }
  const double side_a = verify__side(&m[0], &a);
  const int opens_a = b.count == 1 || (a.count > 1 && side_a >= verify__side(&m[1], &b));
  nsvcd_verify_node child[2];
  if (a.count == 1 && b.count == 1) return 0;
  put(w, 0, 1);
  verify__children(opens_a ? &a : &b, child);
  for (int k = 0; k < 2; k++)
    if (!put_walk(w, m, opens_a ? child[k] : a, opens_a ? b : child[k])) return 0;
  return 1;
}

// ---- arithmetic

static void checker_refuses_arithmetic(void) {
  static const int modes[] = {
#ifdef FE_UPWARD
      FE_UPWARD,
#endif
#ifdef FE_DOWNWARD
      FE_DOWNWARD,
#endif
#ifdef FE_TOWARDZERO
      FE_TOWARDZERO,
#endif
      0};
  scene s;
  writer w;
  nsvcd_verify_report report;
  scene_of(1.5f, &s);
  CHECK(!scene_init(&s));
  begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
  put_plane(&w, -1, 0, 0);
  CHECK(check_bytes(s.movers, 0, &w, &report));
  const int nearest = fegetround();
  for (size_t k = 0; k + 1 < sizeof modes / sizeof *modes; k++) {
    tetrahedron other;
    if (fesetround(modes[k])) continue;
    // does it reach what is calculated? Not under valgrind
    volatile double one = 1, little = 1e-17;
    volatile double above = one + little, below = one - little;
    const int rounds = above > 1 || below < 1;
    const int accepted = check_bytes(s.movers, 0, &w, &report);
    const char *why = tetrahedron_of(1, NULL, 0, &other);
    fesetround(nearest);
    CHECK(!rounds || (!accepted && report.reason && strstr(report.reason, "round")));
    CHECK(!rounds || why);
    CHECK(check_bytes(s.movers, 0, &w, &report));
  }
#ifdef HAS_SUBNORMAL_SWITCH
  const unsigned int kept = _mm_getcsr();
  tetrahedron other;
  _mm_setcsr(kept | 0x8040);  // flush to zero, subnormals are zero
  volatile float least = 1e-45f;
  volatile double seen = (double)least;
  const int vanish = !(seen > 0);
  const int accepted = check_bytes(s.movers, 0, &w, &report);
  const char *why = tetrahedron_of(1, NULL, 0, &other);
  _mm_setcsr(kept);
  CHECK(!vanish || (!accepted && report.reason && strstr(report.reason, "subnormal")));
  CHECK(!vanish || why);
#endif
  CHECK(check_bytes(s.movers, 0, &w, &report));
}

// Floats that are no numbers, by their bits, and the first beyond a limit.
static float bad_float(int which, float limit) {
  static const uint32_t bits[] = {0x7fc00000, 0xffc00000, 0x7f800001,
                                  0x7fffffff, 0x7f800000, 0xff800000};
  float x;
  if (which == 6) return nextafterf(limit, 2 * limit);
  if (which == 7) return -nextafterf(limit, 2 * limit);
  memcpy(&x, &bits[which], sizeof x);
  return x;
}
static double bad_double(int which, double limit) {
  static const uint64_t bits[] = {0x7ff8000000000000u, 0xfff8000000000000u, 0x7ff0000000000001u,
                                  0x7fffffffffffffffu, 0x7ff0000000000000u, 0xfff0000000000000u};
  double x;
  if (which == 6) return nextafter(limit, 2 * limit);
  if (which == 7) return -nextafter(limit, 2 * limit);
  memcpy(&x, &bits[which], sizeof x);
  return x;
}

static void checker_refuses_what_is_no_number(void) {
  for (int which = 0; which < 8; which++) {
    scene s;
    writer w;
    nsvcd_verify_report report;
    const float far_off = bad_float(which, 1e6f);
    for (int i = 0; i < 15; i++) {
      // the last three are of a vertex of no triangle
      const float stray[3] = {2, 2, 2};
      CHECK(!tetrahedron_of(1, stray, 0, &s.a));
      s.a.positions[i] = far_off;
      CHECK(nsvcd_verify_mesh_init(s.a.positions, 5, s.a.indices, 4, s.a.memory, &s.a.mesh));
    }
    scene_of(1.5f, &s);
    for (int n = 0; n < 2; n++) {
      s.paths[n].count = 3;
      s.paths[n].times = s.times[n];
      for (int i = 0; i < 21; i++) {
        const float kept = s.poses[n][i];
        s.poses[n][i] = far_off;
        CHECK(scene_init(&s));
        s.poses[n][i] = kept;
      }
      for (int k = 0; k < 3; k++) {
        const float kept = s.times[n][k];
        s.times[n][k] = bad_float(which, 1);
        CHECK(scene_init(&s));
        s.times[n][k] = kept;
      }
      CHECK(nsvcd_verify_path_init(&s.a.mesh, far_off, &s.paths[n], &s.movers[n]));
    }
    CHECK(!scene_init(&s));
    const float clearance = bad_float(which, 1e6f);
    begin(&w, s.movers, clearance, NSVCD_VERIFY_FREE);
    put_plane(&w, -1, 0, 0);
    CHECK(!check_bytes(s.movers, clearance, &w, &report));
    CHECK(report.reason && strstr(report.reason, "clearance"));
  }
}

// A motion of one's own that places something nowhere, leaves its chord nobody knows how far, or is
// known nowhere.
static int lost, lost_as;
static void lost_place(const void *motion, double t, nsvcd_verify_place *place) {
  verify__path_place(motion, t, place);
  if (lost < 3) place->at[lost] = bad_double(lost_as, 0);
  if (lost >= 3 && lost < 12) place->turn[lost - 3] = bad_double(lost_as, 0);
}
static void lost_deviation(const void *motion, double t0, double t1, double *deviation) {
  verify__path_deviation(motion, t0, t1, deviation);
  if (lost >= 12 && lost < 18) deviation[lost - 12] = bad_double(lost_as, 0);
}
static void checker_refuses_to_place_nowhere(void) {
  for (int k = 0; k < 20 * 6; k++) {
    for (int n = 0; n < 2; n++) {
      lost = k / 6;
      lost_as = k % 6;
      if (lost_as == 5 && lost >= 12 && lost < 19) continue;  // less than nothing is no motion
      scene s;
      writer w;
      nsvcd_verify_report report;
      scene_of(1.5f, &s);
      CHECK(!scene_init(&s));
      begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
      put_plane(&w, -1, 0, 0);
      s.movers[n].place = lost_place;
      s.movers[n].deviation = lost_deviation;
      if (lost == 18) s.movers[n].reach = bad_double(lost_as, 0);
      CHECK_EQ(check_bytes(s.movers, 0, &w, &report), lost == 19);
    }
  }
}

// ---- memory

// The workspace and the memory of meshes hold signalling NaNs at first: to calculate with one is an
// invalid operation, which is told where there are flags.
static void checker_reads_what_it_wrote(void) {
  static const uint64_t noise[] = {0x7ff0000000000001u, 0x7f8000017f800001u, 0};
  for (size_t k = 0; k < sizeof noise / sizeof *noise; k++) {
    scene s;
    writer w;
    nsvcd_verify_report report;
    uint64_t workspace[NSVCD_VERIFY_WORKSPACE_BYTES(16) / 8];
    scene_of(1.5f, &s);
    s.paths[0].count = 3;
    for (int i = 0; i < 3; i++) s.poses[0][7 * i + 1] = 0.1f * (float)i;
#ifdef FE_INVALID
    feclearexcept(FE_INVALID);
#endif
    tetrahedron *both[2] = {&s.a, &s.b};
    for (int n = 0; n < 2; n++) {
      for (size_t i = 0; i < sizeof both[n]->memory / 8; i++) both[n]->memory[i] = noise[k];
      CHECK(!nsvcd_verify_mesh_init(both[n]->positions, 4, both[n]->indices, 4, both[n]->memory,
                                    &both[n]->mesh));
    }
    CHECK(!scene_init(&s));
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    put_plane(&w, -1, 0, 0);
    for (size_t i = 0; i < sizeof workspace / 8; i++) workspace[i] = noise[k];
    CHECK(nsvcd_verify(&s.movers[0], &s.movers[1], 0, w.bytes, (w.bits + 7) / 8, workspace,
                       sizeof workspace, &report));
#ifdef FE_INVALID
    CHECK(!fetestexcept(FE_INVALID));
#endif
  }
}

// ---- normals and rays

// Nothing is parted by a normal of 0, which all eight are before any is written, and no ray goes
// along it.
static void checker_needs_a_normal(void) {
  scene s;
  writer w;
  nsvcd_verify_report report;
  for (int k = 0; k < 8; k++) {
    scene_of(1000, &s);
    CHECK(!scene_init(&s));
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    put(&w, k ? 5 : 3, k ? 3 : 2);  // by the last one; by the one k + 1 before it
    if (k) put(&w, 1, k);
    CHECK(!check_bytes(s.movers, 0, &w, &report));
    CHECK(report.reason && strstr(report.reason, "plane"));
    // one that is written before, and then one that is not
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    put(&w, 4, 3);
    put_plane(&w, -1, 0, 0);
    put(&w, k ? 5 : 3, k ? 3 : 2);
    if (k) put(&w, 1, k);
    CHECK_EQ(check_bytes(s.movers, 0, &w, &report), k == 0);
  }
  // b is small and in a: the walk holds, and rays along 0, or along the same as ever, prove nothing
  scene_of(0.1f, &s);
  s.poses[1][1] = s.poses[1][2] = 0.1f;
  CHECK(!nsvcd_verify_path_init(&s.a.mesh, 1, &s.paths[0], &s.movers[0]));
  CHECK(!nsvcd_verify_path_init(&s.b.mesh, 0.1f, &s.paths[1], &s.movers[1]));
  const nsvcd_verify_node root = {0, 0, 4};
  for (int k = 0; k <= 27; k++) {
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    CHECK(put_walk(&w, s.movers, root, root));
    CHECK_LE(w.bits, 8 * ROOM - 64);
    if (k == 27) CHECK(!check_bytes(s.movers, 0, &w, &report));  // none at all
    if (k == 13 || k == 27) continue;
    for (int n = 0; n < 2; n++) {
      put(&w, 0, 1);
      put_normal(&w, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    }
    CHECK(!check_bytes(s.movers, 0, &w, &report));
  }
  for (int k = 1; k < 8; k++) {
    begin(&w, s.movers, 0, NSVCD_VERIFY_INSIDE);
    put(&w, 0, 32);
    put(&w, 1, 1);
    put(&w, 0, 32);
    const writer before = w;
    put(&w, 1, k);
    CHECK(!check_bytes(s.movers, 0, &w, &report));
    w = before;
    put_normal(&w, 0, -1, 1);
    CHECK_EQ(check_bytes(s.movers, 0, &w, &report), 1);
  }
}

// ---- vertices of no triangle

static void checker_looks_at_triangles(void) {
  // by itself, in a; at a corner's place, before all others and behind them
  static const float strays[3][3] = {{2, 1, 1}, {0, 0, 0}, {0, 1, 0}};
  for (int n = 0; n < 6; n++) {
    const int first = n % 2;
    const int at_corner = n >= 2;
    scene s;
    writer w;
    nsvcd_verify_report report;
    // b, small, in a; then beside it
    scene_of(0.1f, &s);
    CHECK(!tetrahedron_of(1, strays[n / 2], first, &s.b));
    s.poses[1][1] = s.poses[1][2] = 0.1f;
    CHECK(!nsvcd_verify_path_init(&s.a.mesh, 1, &s.paths[0], &s.movers[0]));
    CHECK(!nsvcd_verify_path_init(&s.b.mesh, 0.1f, &s.paths[1], &s.movers[1]));
    const nsvcd_verify_node root = {0, 0, 4};
    const nsvcd_verify_node leaf = {0, 0, 1};
    CHECK_LE(verify__radius(&s.movers[1], &leaf), 0.1 * 1.74);
    // it is inside: by any of its corners, and by the stray one only where that is at a corner
    for (uint32_t vertex = 0; vertex < 5; vertex++) {
      begin(&w, s.movers, 0, NSVCD_VERIFY_INSIDE);
      put(&w, 0, 32);
      put(&w, 1, 1);
      put(&w, vertex, 32);
      put_normal(&w, 1, 0, 0);
      const int is_stray = vertex == (first ? 0u : 4u);
      const int accepted = check_bytes(s.movers, 0, &w, &report);
      if (is_stray && !at_corner) CHECK(!accepted);
      if (!is_stray) CHECK(accepted);
    }
    // and not free: one ray for each, whatever vertex stands for it
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    CHECK(put_walk(&w, s.movers, root, root));
    for (int k = 0; k < 2; k++) {
      put(&w, 0, 1);
      put_normal(&w, 1, 0, 0);
    }
    CHECK(!check_bytes(s.movers, 0, &w, &report));
    CHECK(report.reason && strstr(report.reason, "ray"));
    s.poses[1][0] = 1.5f;
    CHECK(!nsvcd_verify_path_init(&s.b.mesh, 0.1f, &s.paths[1], &s.movers[1]));
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    put_plane(&w, -1, 0, 0);
    CHECK(check_bytes(s.movers, 0, &w, &report));
  }
}

// ---- knots

// A half turn, then rest, then a half turn: what a point does between two neighbouring doubles of
// which one is a knot, the deviation or the margin holds.
static void checker_knows_neighbours_of_knots(void) {
  static const float quarter[4] = {0, 0, 1, 0};
  scene s;
  scene_of(1.5f, &s);
  memcpy(s.poses[0] + 10, quarter, sizeof quarter);
  memcpy(s.poses[0] + 17, quarter, sizeof quarter);
  s.paths[0].count = 3;
  for (int timed = 0; timed < 2; timed++) {
    s.times[0][1] = 0.25f + 1.1e-7f;
    s.paths[0].times = timed ? s.times[0] : NULL;
    CHECK(!scene_init(&s));
    const nsvcd_verify_mover *m = &s.movers[0];
    const double keyframe = m->next(m->motion, 0);
    CHECK_NEAR(keyframe, timed ? 0.25 : 0.5, 1e-6);
    for (int steps = 1; steps < 6; steps++) {
      double before = keyframe, deviation[6] = {0};
      for (int k = 0; k < steps; k++) before = nextafter(before, 0);
      CHECK_EQ(m->next(m->motion, before), keyframe);
      m->deviation(m->motion, before, keyframe, deviation);
      const double turn = 3.141592653589793 * (keyframe - before) / keyframe;
      CHECK_GE(deviation[0] + fmax(deviation[1], deviation[2]) + 1e-6 * VERIFY__MARGIN,
               turn * turn / 8);
      m->deviation(m->motion, 0, before, deviation);
      CHECK_GE(deviation[2], 3.141592653589793 * 3.141592653589793 / 8);
    }
  }
}

// Each knot is come by once, also of thirds and sevenths, and also where registers are wider than a
// double (x87): the workspace has room for them and no more.
static void checker_comes_by_knots_once(void) {
  for (size_t count = 2; count <= 80; count++) {
    static double workspace[NSVCD_VERIFY_WORKSPACE_BYTES(80) / sizeof(double)];
    static float poses[7 * 80];
    scene s;
    writer w;
    nsvcd_verify_report report;
    scene_of(1.5f, &s);
    for (size_t k = 0; k < count; k++) {
      memset(poses + 7 * k, 0, 7 * sizeof *poses);
      poses[7 * k + 6] = 1;
    }
    s.paths[0].poses = poses;
    s.paths[0].count = count;
    CHECK(!scene_init(&s));
    size_t keyframes = 1;
    for (double t = 0; t < 1 && keyframes <= count; keyframes++)
      t = s.movers[0].next(s.movers[0].motion, t);
    CHECK_EQ(keyframes, count);
    begin(&w, s.movers, 0, NSVCD_VERIFY_FREE);
    put_plane(&w, -1, 0, 0);
    CHECK(nsvcd_verify(&s.movers[0], &s.movers[1], 0, w.bytes, (w.bits + 7) / 8, workspace,
                       NSVCD_VERIFY_WORKSPACE_BYTES(count), &report));
  }
}

// ---- joints

#define PIECES 2
typedef struct machine {
  nsvcd_verify_joint joints[2];
  double points[(PIECES * NSVCD_VERIFY_DEGREE + 1) * 2], times[PIECES + 1];
  nsvcd_verify_motion motion;
} machine;

// Two joints that slide along x, one on the other, at rest.
static void machine_of(machine *m) {
  memset(m, 0, sizeof *m);
  for (uint32_t k = 0; k < 2; k++) {
    m->joints[k].slides = 1;
    m->joints[k].parent = k;
    m->joints[k].origin[6] = 1;
    m->joints[k].axis[0] = 1;
  }
  for (int k = 0; k <= PIECES; k++) m->times[k] = k;
  m->motion.joints = m->joints;
  m->motion.joint_count = 2;
  m->motion.pieces = PIECES;
  m->motion.degree = 1;
  m->motion.points = m->points;
  m->motion.times = m->times;
}

static void checker_refuses_what_is_no_number_of_joints(void) {
  machine m;
  nsvcd_verify_part part;
  nsvcd_verify_mover mover;
  scene s;
  scene_of(0, &s);
  for (int which = 0; which < 8; which++) {
    machine_of(&m);
    CHECK(!nsvcd_verify_motion_check(&m.motion));
    for (int i = 0; i < 10; i++) {
      float *x = i < 7 ? &m.joints[1].origin[i] : &m.joints[1].axis[i - 7];
      const float kept = *x;
      *x = bad_float(which, i < 7 ? 1e6f : 1e12f);
      CHECK(nsvcd_verify_motion_check(&m.motion));
      *x = kept;
    }
    for (int i = 0; i <= PIECES; i++) {
      const double kept = m.times[i];
      m.times[i] = bad_double(which, 1e9);
      CHECK(nsvcd_verify_motion_check(&m.motion));
      m.times[i] = kept;
    }
    for (int i = 0; i < 2 * (PIECES + 1); i++) {
      m.points[i] = bad_double(which, 1e6);
      CHECK(nsvcd_verify_motion_check(&m.motion));
      m.points[i] = 0;
    }
    memset(&part, 0, sizeof part);
    part.motion = &m.motion;
    part.pose[6] = 1;
    CHECK(!nsvcd_verify_part_init(&s.a.mesh, 1, &part, &mover));
    CHECK(nsvcd_verify_part_init(&s.a.mesh, bad_float(which, 1e6f), &part, &mover));
    for (int i = 0; i < 7; i++) {
      const float kept = part.pose[i];
      part.pose[i] = bad_float(which, 1e6f);
      CHECK(nsvcd_verify_part_init(&s.a.mesh, 1, &part, &mover));
      part.pose[i] = kept;
    }
  }
}

// Link 1 goes along x into what stands in the world, by its own clock; what is told of two clocks,
// or from two links, says nothing of both.
static void checker_needs_one_motion_and_base(void) {
  machine m, other;
  nsvcd_verify_part parts[2];
  nsvcd_verify_mover movers[2];
  nsvcd_verify_report report;
  writer w;
  scene s;
  scene_of(5, &s);
  CHECK(!scene_init(&s));
  machine_of(&m);
  machine_of(&other);
  for (int k = 0; k <= PIECES; k++) m.points[2 * k] = 0.1 * k;
  CHECK(!nsvcd_verify_motion_check(&m.motion));
  CHECK(!nsvcd_verify_motion_check(&other.motion));
  for (int n = 0; n < 6; n++) {
    memset(parts, 0, sizeof parts);
    for (int k = 0; k < 2; k++) {
      parts[k].motion = &m.motion;
      parts[k].link = k ? 2 : 1;
      parts[k].pose[6] = 1;
    }
    parts[1].pose[0] = 3;
    if (n == 1) parts[1].motion = &other.motion;
    if (n == 2) parts[0].motion = &other.motion;
    if (n == 3) parts[1].base = 1;
    if (n == 4) parts[0].base = 1;
    for (int k = 0; k < 2; k++) CHECK(!nsvcd_verify_part_init(&s.a.mesh, 1, &parts[k], &movers[k]));
    if (n == 5) movers[0] = s.movers[0];
    begin(&w, movers, 0, NSVCD_VERIFY_FREE);
    put_plane(&w, -1, 0, 0);
    CHECK_EQ(check_bytes(movers, 0, &w, &report), n == 0);
    CHECK(n == 0 || (report.reason && strstr(report.reason, "one motion")));
  }
}

void test_checker(void) {
  RUN(checker_refuses_arithmetic);
  RUN(checker_refuses_what_is_no_number);
  RUN(checker_refuses_to_place_nowhere);
  RUN(checker_reads_what_it_wrote);
  RUN(checker_needs_a_normal);
  RUN(checker_looks_at_triangles);
  RUN(checker_knows_neighbours_of_knots);
  RUN(checker_comes_by_knots_once);
  RUN(checker_refuses_what_is_no_number_of_joints);
  RUN(checker_needs_one_motion_and_base);
}
CHECK_ALONE(test_checker)
